/* SPDX-License-Identifier: MIT
 *
 * fluids_vortices.c - the vortices of Taylor and Green in a periodic box, by one method after the other, with the
 * order of the error.
 *
 *     cc -O2 -o fluids_vortices examples/fluids/fluids_vortices.c -lm
 *     fluids_vortices -out DIR -figures DIR [-full]       (-h for help)
 *
 * u = -cos(2 pi x) sin(2 pi y), v = sin(2 pi x) cos(2 pi y), times exp(-8 pi^2 nu t), Re = 100 (nu = 0.01),
 * c0 = 10, viscosity of Morris.
 *   From a square lattice, which is the worst to start from (particles are led along its rows, and line up):
 *     all methods with 30 x 30 particles, h = 1.6 dx, dt = 0.25 h / c0, at t = 1.2; some with 50 x 50, h = 2 dx,
 *     dt = 0.375 h / c0, at t = 1.
 *   From an even cloud without rows, which shifting has packed: 20 x 20 and 40 x 40 (-full: 80 x 80) particles,
 *     h = 2 dx, at t = 1, for the order of the error. Three random clouds each: figures are means, and verdicts those
 *     of the worst.
 * Figures: mean error of the velocity, in exp(-8 pi^2 nu t); kinetic energy in that of the start (exact:
 * exp(-16 pi^2 nu t)); noise; distance of the nearest pair, in dx; momentum that has come into being, in
 * sum m |v| of the start.
 * What clustering_flows (../papers) shows of these vortices is another thing: remedies by kernels and collisions.
 */
#include "fluids.h"

enum { ERROR, ENERGY, NOISE, LEAST, MOMENTUM };

static const double nu = 0.01;
static int side, packed;         /* particles in a row; 1: not from a lattice */
static double smoothing, end, cfl; /* h / dx; time; dt c0 / h */

static double decay(double t) { return exp(-8 * MATH_PI * MATH_PI * nu * t); }
static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    const double dx = 1.0 / side;
    const flow_domain all = {0, 0, 0, 0};
    double energy, speed = 0, px = 0, py = 0;
    char what[32];
    liquid l;
    int i, j, k;
    liquid_open(&l, m, dx, smoothing * dx, 10, 0);
    l.f.box_x = l.f.box_y = 1;
    l.f.dt = cfl * l.f.h / l.c0;
    l.speed = 1;
    for (j = 0; j < side; j++)
        for (i = 0; i < side; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 0);
    liquid_start(&l, nu, o);
    if (packed) liquid_pack(&l, seed, 200);
    else liquid_shake(&l, seed);
    for (k = 0; k < l.f.n; k++) {
        const double x = 2 * MATH_PI * l.f.x[k], y = 2 * MATH_PI * l.f.y[k];
        liquid_set_pressure(&l, k, -0.25 * (cos(2 * x) + cos(2 * y)));
        l.f.vx[k] = -cos(x) * sin(y);
        l.f.vy[k] = sin(x) * cos(y);
        speed += l.f.m[k] * hypot(l.f.vx[k], l.f.vy[k]);
    }
    energy = flow_kinetic_energy(&l.f);
    flow_require(&l.f, flow_run(&l.f, end));
    figure[ERROR] = 0;
    for (i = 0; i < l.f.n_fluid; i++) {
        const double x = 2 * MATH_PI * l.f.x[i], y = 2 * MATH_PI * l.f.y[i], now = decay(l.f.t);
        figure[ERROR] += hypot(l.f.vx[i] + cos(x) * sin(y) * now, l.f.vy[i] - sin(x) * cos(y) * now) / now / l.f.n_fluid;
        px += l.f.m[i] * l.f.vx[i];
        py += l.f.m[i] * l.f.vy[i];
    }
    figure[ENERGY] = flow_kinetic_energy(&l.f) / energy;
    figure[NOISE] = liquid_noise(&l);
    figure[LEAST] = flow_measure(&l.f, FLOW_ALL, 0, all, NULL).least;
    figure[MOMENTUM] = hypot(px, py) / speed;
    snprintf(what, sizeof what, "vortices_%d", side);
    liquid_end(&l, what, packed ? seed - 1 : seed, o);
}
/* The order of the error, from the figures of one cloud and of one with half of its spacing. */
static double order_of(const double *coarse, const double *fine) { return log(coarse[ERROR] / fine[ERROR]) / log(2.0); }

int main(int argc, char **argv)
{
#define FIGURES \
    5, {"error of v", "kinetic energy", "noise", "nearest / dx", "momentum"}, {1.5, 2.5, 3, 3, 1e3}, run,
    enum { GRIDS = 3 };
    static const int sides[GRIDS] = {20, 40, 80};
    static const liquid_case vortices = {"30 x 30", FIGURES 0}, larger = {"50 x 50", FIGURES 0},
                             even[GRIDS] = {{"20 x 20, even", FIGURES 1}, {"40 x 40, even", FIGURES 1}, {"80 x 80, even", FIGURES 1}};
    /* 30 x 30 particles with h = 1.6 dx at t = 1.2; 50 x 50 with h = 2 dx at t = 1 */
    enum { PLAIN, MOLTENI, ANTUONO, SKILLEN, SUN, SUN_2019, TRANSPORT, RIEMANN, LATE, METHODS = LATE + 4 };
    static const liquid_trial trial[METHODS] = {{METHOD_PLAIN, {.626, .0022}, 0},
                                                {METHOD_MOLTENI, {.559}, 1},
                                                {METHOD_ANTUONO, {.565, .0061}, 0},
                                                {METHOD_SKILLEN, {.533}, 0},
                                                {METHOD_SUN, {.132, .098}, 0},
                                                {METHOD_SUN_2019, {.087, .114, .014}, 0},
                                                {METHOD_TRANSPORT, {.364, .033}, 0},
                                                {METHOD_RIEMANN, {.592, .0049, .0053}, 0},
                                                {METHOD_LATE, {0}, 0},
                                                {METHOD_EDAC, {0}, 1},
                                                {METHOD_SUN_ALONE, {.153, .0905, .28}, 1},
                                                {METHOD_SUN_MOVING, {0}, 1}};
    enum { FINE_PLAIN, FINE_ANTUONO, FINE_SUN, FINE_TRANSPORT, FINES };
    static const liquid_trial fine[FINES] = {{METHOD_PLAIN, {.444, .029, .229, .30}, 0},
                                             {METHOD_ANTUONO, {.354, .055, .0217}, 1},
                                             {METHOD_SUN, {.046, .180, 0, .73}, 0},
                                             {METHOD_TRANSPORT, {0}, 1}}; /* the trial had another step, on which it depends */
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x, y, z[GRIDS];
    liquid_trial unknown[FINES];
    char text[96];
    double order[FINES][LIQUID_SEEDS], worst = 0;
    int g, t, s;
    options_parse(argc, argv, "The vortices of Taylor and Green, by one method after the other.", specs,
                  FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_vortices", o.out);
    figure_folder(o.figures, "fluids_vortices");
    side = 30;
    smoothing = 1.6;
    cfl = 0.25;
    end = 1.2;
    snprintf(text, sizeof text, "h = 1.6 dx, t = 1.2; exact energy: %.4f", decay(end) * decay(end));
    report_section(&r, text);
    liquid_compare(&r, &vortices, trial, METHODS, &o, &x);
    if (o.method) return report_close(&r) ? 1 : 0;
    side = 50;
    smoothing = 2;
    cfl = 0.375;
    end = 1;
    snprintf(text, sizeof text, "h = 2 dx, t = 1; exact energy: %.4f", decay(end) * decay(end));
    report_section(&r, text);
    liquid_compare(&r, &larger, fine, FINES, &o, &y);
    report_section(&r, "The same from an even cloud without rows");
    memcpy(unknown, fine, sizeof fine);
    for (t = 0; t < FINES; t++) memset(unknown[t].known, 0, sizeof unknown[t].known);
    packed = 1;
    for (g = 0; g < (o.full ? GRIDS : GRIDS - 1); g++) {
        side = sides[g];
        liquid_compare(&r, &even[g], unknown, FINES, &o, &z[g]);
        for (t = 0; t < FINES && g > 0; t++) {
            if (!liquid_wanted(&fine[t], &o)) continue;
            snprintf(text, sizeof text, "order of the error, %d to %d", sides[g - 1], side);
            report_info(&r, "even", fine[t].method.name, text,
                        order_of(z[g - 1].figure[t], z[g].figure[t]));
            for (s = 0; s < LIQUID_SEEDS; s++)
                order[t][s] = order_of(z[g - 1].seen[t][s], z[g].seen[t][s]);
            liquid_range(&r, "even", fine[t].method.name, text, order[t], 1);
        }
    }
    report_section(&r, "What shifting is worth, and what it costs");
    report_range(&r, "vortices", "30 x 30, Antuono, Sun 2017", "error of v", (double)NAN, x.figure[SUN][ERROR], 0, 0.16);
    report_range(&r, "vortices", "30 x 30, Antuono", "error of v without shifting", (double)NAN,
                 x.figure[ANTUONO][ERROR], 0.5, 1);
    report_range(&r, "vortices", "30 x 30, plain", "momentum: none without shifting", (double)NAN,
                 x.figure[PLAIN][MOMENTUM], 0, 1e-12);
    report_range(&r, "vortices", "30 x 30, Antuono, Sun 2019", "momentum is not conserved", (double)NAN,
                 x.figure[SUN_2019][MOMENTUM], 1e-6, 1e-2);
    report_range(&r, "vortices", "30 x 30, Riemann", "error of v: no remedy against lines", (double)NAN,
                 x.figure[RIEMANN][ERROR], 0.5, 1);
    for (s = 0; s < LIQUID_SEEDS; s++) worst = fmax(worst, z[1].seen[FINE_PLAIN][s][ERROR]);
    report_range(&r, "vortices", "plain, even / lattice", "error of v: an even start is half of the remedy", (double)NAN,
                 worst / y.figure[FINE_PLAIN][ERROR], 0, 0.4);
    for (s = 0; s < LIQUID_SEEDS; s++) {
        snprintf(text, sizeof text, "order of the error, %d to %d, cloud %d", sides[0], sides[1], s + 1);
        report_range(&r, "vortices", "even, Antuono, Sun 2017", text, (double)NAN,
                     order_of(z[0].seen[FINE_SUN][s], z[1].seen[FINE_SUN][s]), 0.5, 2.5);
    }
    report_range(&r, "vortices", "30 x 30, pressure half a step late", "kinetic energy: it grows", (double)NAN,
                 x.figure[LATE][ENERGY], 1.2, 1e3);
    return report_close(&r) ? 1 : 0;
}
