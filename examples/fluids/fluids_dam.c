/* SPDX-License-Identifier: MIT
 *
 * fluids_dam.c - a dam breaks: the front beside experiments, and the noise of the pressure, by one method after
 * the other.
 *
 *     cc -O2 -o fluids_dam examples/fluids/fluids_dam.c -lm
 *     fluids_dam -out DIR -figures DIR [-full]       (-h for help)
 *
 * A column of A x 2 A in a tank of 4 A x 3 A, 20 x 40 particles, walls of Adami's ghosts, h = 1.6 dx,
 * c0 = 20 sqrt(gA), alpha = 0.02, from rest with the pressure rho g (2 A - y). Lengths are in A, times in
 * sqrt(A / g). Figures: noise of the pressure at t = 1.2, when the front is near the middle of the tank, and at
 * 2.4, when it has hit the wall, in rho g A; the front at 1.2; share of the particles that are nearer than
 * dx / 2 to another; energy at 1.2, in that of the start, where only methods with energy of their own gain any.
 * Martin & Moyce 1952 and Koshizuka & Oka 1996 stand beside the front (../common/column.h).
 */
#include "fluids.h"
#include "../common/column.h"

enum { EARLY, LATE, FRONT, CLUSTERED, ENERGY };

static front_record front; /* of the run that has ended last, in metres and seconds */

static double farthest(const flow *f)
{
    double x = 0;
    int i;
    for (i = 0; i < f->n_fluid; i++) x = fmax(x, f->x[i] + 0.5 * f->dref);
    return x;
}
static void watch(flow *f)
{
    const double t = f->t * sqrt(column_a / column_gravity);
    if (front_due(&front, t)) front_add(&front, t, farthest(f) * column_a);
}
static double energy(const liquid *l)
{
    return flow_kinetic_energy(&l->f) + liquid_height(l) * liquid_mass(l);
}
static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    enum { SIDE = 20 };
    const double dx = 1.0 / SIDE;
    const flow_domain all = {0, 0, 0, 0};
    liquid l;
    double before;
    int i, j;
    liquid_open(&l, m, dx, 1.6 * dx, 20, 0.02);
    l.f.gravity_y = -1;
    l.surface = 1;
    for (j = 0; j < 2 * SIDE; j++)
        for (i = 0; i < SIDE; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 2 - (j + 0.5) * dx);
    liquid_add_tank(&l, 4 * SIDE, 3 * SIDE);
    liquid_start(&l, 0, o);
    liquid_shake(&l, seed);
    front.count = 0;
    front.every = 2.4 * sqrt(column_a / column_gravity) / (FRONT_SAMPLES - 1);
    l.f.after = watch;
    watch(&l.f);
    before = energy(&l);
    flow_require(&l.f, flow_run(&l.f, 1.2));
    figure[EARLY] = liquid_noise(&l);
    figure[FRONT] = farthest(&l.f);
    figure[ENERGY] = energy(&l) / before;
    flow_require(&l.f, flow_run(&l.f, 2.4));
    figure[LATE] = liquid_noise(&l);
    figure[CLUSTERED] = flow_measure(&l.f, FLOW_ALL, 0, all, NULL).below_50;
    liquid_end(&l, "dam", seed, o);
}

int main(int argc, char **argv)
{
    static const liquid_case dam = {
        "dam",
        5,
        {"noise at t = 1.2", "noise at t = 2.4", "front at t = 1.2", "f(<0.5) at t = 2.4", "energy at t = 1.2"},
        {1.5, 2.5, 1.02, 4, 1.02},
        run};
    enum { PLAIN, MOLTENI, ANTUONO, FOURTAKAS, SUN, RIEMANN, METHODS = RIEMANN + 5 };
    static const liquid_trial trial[METHODS] = {{METHOD_PLAIN, {.497, 0, 2.174, .106}, 0},
                                                {METHOD_MOLTENI, {.0769, 0, 2.178}, 0},
                                                {METHOD_ANTUONO, {.0727, 0, 2.178, .061}, 0},
                                                {METHOD_FOURTAKAS, {.0704, 0, 2.178}, 0},
                                                {METHOD_SUN, {.0382}, 0},
                                                {METHOD_RIEMANN, {.0405, 0, 2.226, 0, .9939}, 0},
                                                {METHOD_RIEMANN_GRAVITY, {0}, 1},
                                                {METHOD_EDAC, {0}, 1},
                                                {METHOD_SKILLEN, {0}, 1},
                                                {METHOD_SUN_2019, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x;
    options_parse(argc, argv, "A dam breaks, by one method after the other.", specs, FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_dam", o.out);
    figure_folder(o.figures, "fluids_dam");
    liquid_compare(&r, &dam, trial, METHODS, &o, &x);
    return report_close(&r) ? 1 : 0;
}
