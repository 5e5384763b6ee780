/* SPDX-License-Identifier: MIT
 *
 * gas_polytrope.c - a ball of gas settles under its own gravity: the polytrope of index 1.
 *
 *     cc -O2 -o gas_polytrope examples/gas/gas_polytrope.c -lm
 *     gas_polytrope -out DIR [-full]       (-h for help)
 *
 * G = M = 1, P = K rho^2 with K = 2 / pi, for which the radius is R = pi sqrt(K / (2 pi G)) = 1, rho = sin(pi r) / (4 r),
 * and the energies are -3/4 (gravity) and 1/4 (Lane and Emden; Chandrasekhar 1939, chapter IV). The start is a ball of
 * the radius 1 of one density, on a lattice of cubes, moved off it at random by up to a tenth of a spacing: it contracts,
 * and swings. v loses half of itself in the time 0.35, until t = 4; then it is left alone to t = 5, and must stay, and keep
 * its energy. u is K rho at all times. Gravity is that of the tree (theta = 0.5), softened by the kernel, with the term of
 * an h that follows the density. The error of rho falls with h^2 within, and the surface, where rho has a kink, is wide
 * by h.
 */
#define GAS_DIM 3
#include "gas_cases.h"

#include "../common/random.h"

static const double K = 2 / MATH_PI, SETTLED = 4, END = 5, LOSS = 0.5;
static double density(double r) { return r < 1 ? sin(MATH_PI * r) / (4 * r) : 0; }

typedef struct profile {
    double l1, middle, radius; /* the mass-weighted mean of |rho - exact| over the exact mean; rho for r < 0.2, over the exact one; root of the mean r^2 */
} profile;
static profile profile_of(const gas *g)
{
    double there = 0, inside = 0;
    profile p = {0, 0, 0};
    sph_index i;
    for (i = 0; i < g->n; i++) {
        const double r = sqrt(gas_square(g, X, i));
        p.l1 += fabs(g->a[RHO][i] - density(r));
        there += density(r);
        p.radius += r * r / g->n;
        if (r < 0.2) {
            p.middle += g->a[RHO][i];
            inside += density(r);
        }
    }
    p.l1 /= there;
    p.middle /= inside;
    p.radius = sqrt(p.radius);
    return p;
}
static void isentropic(gas *g)
{
    sph_index i;
    for (i = 0; i < g->n; i++) g->a[U][i] = K * g->a[RHO][i];
}

int main(int argc, char **argv)
{
    static report r;
    const gas_options o = gas_begin(argc, argv, &r, "gas_polytrope", "A ball of gas settles under its own gravity.", "four times as many particles");
    const int side = o.full ? 11 : 7;
    gas g = gas_new(3, gas_ball(3, side, NULL), 2);
    const double spacing = 1.0 / side;
    double kept = 0, worst = 0;
    profile start, end;
    gas_sums s;
    progress p;
    pcg32 random;
    FILE *data;
    char at[32];
    sph_index i;
    int k;
    gas_ball(3, side, g.a + X);
    pcg32_seed(&random, 1, 1);
    for (i = 0; i < g.n; i++) {
        for (k = 0; k < 3; k++) g.a[X + k][i] += 0.2 * spacing * (pcg32_uniform(&random) - 0.5);
        g.a[M][i] = 1.0 / g.n;
        g.a[H][i] = g.eta * spacing;
        g.a[U][i] = K * 3 / (4 * MATH_PI);
    }
    g.G = 1;
    g.run = "polytrope";
    gas_start(&g);
    start = profile_of(&g);
    data = figure_open(o.figures, "gas_polytrope_energies");
    fprintf(data, "t,kinetic,thermal,gravity,total\n");
    progress_begin(&p, g.run, o.quiet);
    while (g.t < END) {
        const double stop = g.t < SETTLED ? SETTLED : END, dt = fmin(gas_longest_step(&g, 0.3), stop - g.t), before = g.t;
        gas_leap(&g, dt);
        if (stop - g.t < 1e-12) g.t = stop;
        isentropic(&g);
        if (g.t <= SETTLED)
            for (k = 0; k < 3; k++)
                for (i = 0; i < g.n; i++) g.a[VX + k][i] *= exp(-dt / LOSS);
        if (floor(10 * g.t) > floor(10 * before) || g.t >= END || g.t == SETTLED) {
            const double phi = gas_potential(&g);
            s = gas_measure(&g);
            fprintf(data, "%.6g,%.6g,%.6g,%.6g,%.6g\n", g.t, s.kinetic, s.thermal, phi, s.total + phi);
            if (g.t == SETTLED) kept = s.total + phi;
            else if (g.t > SETTLED) worst = fmax(worst, fabs(s.total + phi - kept));
        }
        progress_update(&p, g.t / END);
    }
    progress_end(&p);
    figure_close(data);
    end = profile_of(&g);
    s = gas_measure(&g);
    snprintf(at, sizeof at, "%ld particles", (long)g.n);
    report_section(&r, "Settled");
    {
        const double phi = gas_potential(&g);
        report_relative(report_beside(&r, REPORT_THEORY), "polytrope", at, "energy of gravity", -0.75, phi, 0.04);
        report_relative(report_beside(&r, REPORT_THEORY), "polytrope", at, "thermal energy", 0.25, s.thermal, 0.04);
        report_absolute(report_beside(&r, REPORT_THEORY), "polytrope", at, "virial: 3 U + W", 0, 3 * s.thermal + phi, 0.01);
    }
    report_relative(report_beside(&r, REPORT_THEORY), "polytrope", at, "root of the mean r^2", sqrt(1 - 6 / (MATH_PI * MATH_PI)), end.radius, 0.03);
    report_relative(report_beside(&r, REPORT_THEORY), "polytrope", at, "rho for r < 0.2, over the exact one", 1, end.middle, 0.06);
    report_absolute(report_beside(&r, REPORT_THEORY), "polytrope", at, "L1 of rho / mean rho", 0, end.l1, 0.06);
    report_info(&r, "polytrope", at, "the same at the start", start.l1);
    report_range(&r, "polytrope", at, "end / start", (double)NAN, end.l1 / start.l1, 0, 0.2);
    report_absolute(report_beside(&r, REPORT_THEORY), "polytrope", at, "kinetic energy", 0, s.kinetic, 1e-3);
    report_absolute(report_beside(&r, REPORT_THEORY), "polytrope", at, "change of the energy while it is left alone", 0, worst, 1e-3);
    report_absolute(report_beside(&r, REPORT_THEORY), "polytrope", at, "momentum: the error of the tree", 0, s.momentum, 1e-3);
    data = figure_open(o.figures, "gas_polytrope_profile");
    fprintf(data, "r,rho,exact\n");
    for (i = 0; i < g.n; i++) {
        const double q = sqrt(gas_square(&g, X, i));
        fprintf(data, "%.6g,%.6g,%.6g\n", q, g.a[RHO][i], density(q));
    }
    figure_close(data);
    gas_close(&g);
    return report_close(&r) ? 1 : 0;
}
