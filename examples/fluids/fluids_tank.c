/* SPDX-License-Identifier: MIT
 *
 * fluids_tank.c - water at rest in a tank: what a method makes of a column that should do nothing.
 *
 *     cc -O2 -o fluids_tank examples/fluids/fluids_tank.c -lm
 *     fluids_tank -out DIR -figures DIR [-full]       (-h for help)
 *
 * A square of H x H, 20 x 20 particles (-full: 40 x 40, too), walls of Adami's ghosts, h = 1.6 dx, c0 = 20 sqrt(gH),
 * alpha = 0.02, from rest with the hydrostatic pressure to t = 10 sqrt(H / g). In water that is at rest the centre
 * of mass stays where it is, and p = rho g (H - y). Figures: rise of the centre of mass, in H; rms error of the
 * pressure, in rho g H; its noise, which is what a linear fit to the neighbours leaves.
 */
#include "fluids.h"

enum { RISE, ERROR, NOISE };

static int side = 20; /* particles across */

static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    const double dx = 1.0 / side;
    liquid l;
    double before;
    int i, j;
    liquid_open(&l, m, dx, 1.6 * dx, 20);
    l.f.gravity_y = -1;
    l.f.alpha = 0.02;
    for (j = 0; j < side; j++)
        for (i = 0; i < side; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 1 - (j + 0.5) * dx);
    liquid_add_tank(&l, side, side + 4);
    liquid_start(&l, 0, o);
    liquid_shake(&l, seed);
    before = liquid_height(&l);
    flow_require(&l.f, flow_run(&l.f, 10));
    figure[RISE] = liquid_height(&l) - before;
    figure[ERROR] = 0;
    for (i = 0; i < l.f.n_fluid; i++) {
        const double off = l.f.p[i] - (1 - l.f.y[i]);
        figure[ERROR] += off * off / l.f.n_fluid;
    }
    figure[ERROR] = sqrt(figure[ERROR]);
    figure[NOISE] = liquid_noise(&l);
    liquid_end(&l, "tank", seed, o);
}

int main(int argc, char **argv)
{
    static const liquid_case tank = {
        "tank", 3, {"rise of the centre of mass / H", "pressure error / rho g H", "noise / rho g H"},
        {2, 2, 2}, run};
    enum { PLAIN, EDAC, LATE, METHODS };
    static const liquid_trial trial[METHODS] = {
        {{"plain", "plain", 0, 0}, {-2.0e-4, .0269, 0}},
        {{"EDAC", "edac", LIQUID_EDAC, 0}, {0}},
        {{"plain, pressure half a step late", "late", 0, 1}, {0}},
    };
    fluids_options o = {".", ".", 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x;
    options_parse(argc, argv, "Water at rest in a tank, by one method after the other.", specs,
                  FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_tank", o.out);
    figure_folder(o.figures, "fluids_tank");
    liquid_compare(&r, &tank, trial, METHODS, &o, &x);
    return report_close(&r) ? 1 : 0;
}
