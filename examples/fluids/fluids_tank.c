/* SPDX-License-Identifier: MIT
 *
 * fluids_tank.c - water at rest in a tank: what a method makes of a column that should do nothing.
 *
 *     cc -O2 -o fluids_tank examples/fluids/fluids_tank.c -lm
 *     fluids_tank -out DIR -figures DIR [-full]       (-h for help)
 *
 * A square of H x H, 20 x 20 particles, walls of Adami's ghosts, h = 1.6 dx, c0 = 20 sqrt(gH),
 * alpha = 0.02, dt = 0.5 h / c0, from rest with the hydrostatic pressure to t = 10 sqrt(H / g). In water that is at rest the centre
 * of mass stays where it is, and p = rho g (H - y). Figures: rise of the centre of mass, in H; rms error of the
 * pressure, in rho g H; its noise, which is what a linear fit to the neighbours leaves.
 */
#include "fluids.h"

enum { RISE, ERROR, NOISE };

enum { SIDE = 20 }; /* particles across */

static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    const double dx = 1.0 / SIDE;
    liquid l;
    double before;
    int i, j;
    liquid_open(&l, m, dx, 1.6 * dx, 20, 0.02);
    l.f.gravity_y = -1;
    l.surface = 1;
    l.speed = 1;
    l.f.dt = 0.5 * l.f.h / l.c0;
    for (j = 0; j < SIDE; j++)
        for (i = 0; i < SIDE; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 1 - (j + 0.5) * dx);
    liquid_add_tank(&l, SIDE, SIDE + 4);
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
        {2, 2, 2}, run, 0};
    enum { PLAIN, MOLTENI, ANTUONO, FOURTAKAS, SUN, RIEMANN, RIEMANN_GRAVITY, METHODS = RIEMANN_GRAVITY + 5 };
    static const liquid_trial trial[METHODS] = {{METHOD_PLAIN, {-2.0e-4, .0269}, 0},
                                                {METHOD_MOLTENI, {-5.5e-3, .0177}, 0},
                                                {METHOD_ANTUONO, {-1.5e-4, .0067}, 0},
                                                {METHOD_FOURTAKAS, {-1.6e-4, .0063}, 0},
                                                {METHOD_SUN, {0}, 0},
                                                {METHOD_RIEMANN, {0}, 0},
                                                {METHOD_RIEMANN_GRAVITY, {-2.1e-4, .0056}, 0},
                                                {METHOD_EDAC, {0}, 1},
                                                {METHOD_SKILLEN, {0}, 1},
                                                {METHOD_SUN_MOVING, {0}, 1},
                                                {METHOD_SUN_2019, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x;
    options_parse(argc, argv, "Water at rest in a tank, by one method after the other.", specs,
                  FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_tank", o.out);
    figure_folder(o.figures, "fluids_tank");
    liquid_compare(&r, &tank, trial, METHODS, &o, &x);
    if (o.method) return report_close(&r) ? 1 : 0;
    report_section(&r, "What can hold a column");
    report_range(&r, "tank", "Antuono", "rise", (double)NAN, x.figure[ANTUONO][RISE], -5e-4, 5e-4);
    report_range(&r, "tank", "Fourtakas", "rise", (double)NAN, x.figure[FOURTAKAS][RISE], -5e-4, 5e-4);
    report_range(&r, "tank", "Molteni & Colagrossi", "rise: it cannot", (double)NAN, x.figure[MOLTENI][RISE], -8e-3,
                 -3e-3);
    report_range(&r, "tank", "Riemann", "pressure error: it cannot", (double)NAN, x.figure[RIEMANN][ERROR], 0.015, 1);
    report_range(&r, "tank", "Riemann, gravity out of the jump", "rise", (double)NAN, x.figure[RIEMANN_GRAVITY][RISE],
                 -5e-4, 5e-4);
    report_range(&r, "tank", "Antuono, Sun 2017", "pressure error: shifting keeps water moving", (double)NAN,
                 x.figure[SUN][ERROR], 0.01, 0.05);
    return report_close(&r) ? 1 : 0;
}
