/* SPDX-License-Identifier: MIT
 *
 * fluids_patch.c - a square of liquid that rotates in empty space, by one method after the other: negative
 * pressure pulls at particles that line up, and they cluster.
 *
 *     cc -O2 -o fluids_patch examples/fluids/fluids_patch.c -lm
 *     fluids_patch -out DIR -figures DIR [-full]       (-h for help)
 *
 * A square of 1 x 1, 40 x 40 particles, v = omega x r with omega = 1, alpha = 0 or 0.02, h = 2 dx, c0 = 7,
 * to t = 1.5. The pressure of the start is that of an incompressible liquid: lap p = 2 rho omega^2, p = 0 on the
 * sides (Colagrossi 2005, thesis, Rome; Le Touze et al. 2013, Int. J. Numer. Meth. Fluids 73, 660). Figures:
 * noise of the pressure in rho omega^2; share of the particles that are nearer than dx / 2 to another; energy and
 * angular momentum in those of the start.
 */
#include "fluids.h"

enum { NOISE, CLUSTERED, ENERGY, ANGULAR };

/* the double sine series */
static double pressure(double x, double y)
{
    double p = 0;
    int m, n;
    for (m = 1; m < 40; m += 2)
        for (n = 1; n < 40; n += 2)
            p -= 32 / (pow(MATH_PI, 4) * m * n * (m * m + n * n)) * sin(m * MATH_PI * x) * sin(n * MATH_PI * y);
    return p;
}
static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    enum { SIDE = 40 };
    const double dx = 1.0 / SIDE;
    const flow_domain all = {0, 0, 0, 0};
    sph_conserved before, after;
    liquid l;
    int i, j, k;
    liquid_open(&l, m, dx, 2 * dx, 7, 0.02);
    l.speed = 1;
    l.surface = 1;
    for (j = 0; j < SIDE; j++)
        for (i = 0; i < SIDE; i++) {
            const double x = (i + 0.5) * dx, y = (j + 0.5) * dx;
            k = liquid_add(&l, x - 0.5, y - 0.5, pressure(x, y));
            l.f.vx[k] = y - 0.5;
            l.f.vy[k] = 0.5 - x;
        }
    liquid_start(&l, 0, o);
    liquid_shake(&l, seed);
    flow_neighbours(&l.f);
    flow_conserved(&l.f, &before);
    flow_require(&l.f, flow_run(&l.f, 1.5));
    flow_conserved(&l.f, &after);
    figure[NOISE] = liquid_noise(&l);
    figure[CLUSTERED] = flow_measure(&l.f, FLOW_ALL, 0, all, NULL).below_50;
    figure[ENERGY] = after.kinetic_energy / before.kinetic_energy;
    figure[ANGULAR] = after.angular_momentum.z / before.angular_momentum.z;
    liquid_end(&l, "patch", seed, o);
}

int main(int argc, char **argv)
{
    static const liquid_case patch = {"patch",
                                      4,
                                      {"noise", "f(<0.5)", "kinetic energy", "angular momentum"},
                                      {2, 3, 1.02, 1.003},
                                      run, 0};
    enum { INVISCID, PLAIN, ANTUONO_INVISCID, ANTUONO, SUN, RIEMANN, RIEMANN_SUN, METHODS = RIEMANN_SUN + 3 };
    static const liquid_trial trial[METHODS] = {{METHOD_INVISCID, {.422, .44, 0, 1}, 0},
                                                {METHOD_PLAIN, {0}, 0},
                                                {METHOD_ANTUONO_INVISCID, {0}, 0},
                                                {METHOD_ANTUONO, {.0292, .19, .9716, 1}, 0},
                                                {METHOD_SUN, {.021, .015, 0, 1}, 0},
                                                {METHOD_RIEMANN, {.0182, .57, .9728}, 0},
                                                {METHOD_RIEMANN_SUN, {0}, 0},
                                                {METHOD_MOLTENI, {0}, 1},
                                                {METHOD_SUN_2019, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x;
    options_parse(argc, argv, "A square of liquid rotates in empty space, by one method after the other.", specs,
                  FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_patch", o.out);
    figure_folder(o.figures, "fluids_patch");
    liquid_compare(&r, &patch, trial, METHODS, &o, &x);
    if (o.method) return report_close(&r) ? 1 : 0;
    report_section(&r, "What the remedies do");
    report_range(&r, "patch", "plain / Antuono, alpha = 0.02", "ratio of noise: diffusion quiets it", (double)NAN,
                 x.figure[PLAIN][NOISE] / x.figure[ANTUONO][NOISE], 5, 50);
    report_range(&r, "patch", "Antuono, alpha = 0", "f(<0.5): no remedy against clustering", (double)NAN,
                 x.figure[ANTUONO_INVISCID][CLUSTERED], 0.25, 1);
    report_range(&r, "patch", "Riemann", "f(<0.5): nor is this", (double)NAN, x.figure[RIEMANN][CLUSTERED], 0.25, 1);
    report_range(&r, "patch", "Antuono, Sun 2017", "f(<0.5)", (double)NAN, x.figure[SUN][CLUSTERED], 0, 0.1);
    report_range(&r, "patch", "Riemann, Sun 2017", "f(<0.5)", (double)NAN, x.figure[RIEMANN_SUN][CLUSTERED], 0, 0.1);
    report_range(report_beside(&r, REPORT_THEORY), "patch", "Antuono", "angular momentum", 1, x.figure[ANTUONO][ANGULAR],
                 1 - 1e-9, 1 + 1e-9);
    report_range(&r, "patch", "Riemann, Sun 2017", "angular momentum - 1: shifting does not conserve it", (double)NAN,
                 fabs(x.figure[RIEMANN_SUN][ANGULAR] - 1), 1e-6, 1e-2);
    return report_close(&r) ? 1 : 0;
}
