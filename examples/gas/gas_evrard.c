/* SPDX-License-Identifier: MIT
 *
 * gas_evrard.c - the collapse of a cold ball of gas (Evrard 1988, MNRAS 235, 911), beside a solution in one dimension.
 *
 *     cc -O2 -o gas_evrard examples/gas/gas_evrard.c -lm
 *     gas_evrard -out DIR [-full]       (-h for help)
 *
 * G = M = R = 1, gamma = 5/3, rho = 1 / (2 pi r), u = 0.05, at rest: the energy is 0.05 - 2/3. It falls in, a shock runs out,
 * and at t = 1.1 or so most of the energy is heat. The particles: a lattice of cubes in the unit ball, moved off it
 * at random by up to a tenth of a spacing, then radially, r to r^1.5. Gravity is that of the tree (theta = 0.5), softened
 * by the kernel, with the term of an h that follows the density; Phantom's switch of the viscosity, and conductivity by
 * |w|, which leaves a star alone. To t = 1.5; -full: to 3, and more particles. So few of them smear the middle out: the
 * peak of the heat is late and low, and must come nearer with a finer lattice.
 * The figures of other authors (Steinmetz & Mueller 1993, A&A 268, 391; Springel & al. 2001, New Astron. 6, 79) are
 * curves. The solution beside is made here: spherical shells in Lagrangian form with von Neumann & Richtmyer's viscosity
 * (1950, J. Appl. Phys. 21, 232), 400 of one mass; 200 tell how good it is.
 */
#define GAS_DIM 3
#include "gas_cases.h"

#include "../common/random.h"

static const double GAMMA = 5.0 / 3, U0 = 0.05;
enum { TIMES = 61 }; /* every 0.05 */
static double due(int k) { return 0.05 * k; }
typedef struct history {
    double kinetic[TIMES], thermal[TIMES], gravity[TIMES], peak, at; /* peak: of the thermal energy, and its time */
} history;

/* ---- shells: r, v at edges, u, rho between them ---- */

enum { SHELLS = 400 };
static void shells(int n, double end, history *out)
{
    static double r[SHELLS + 1], v[SHELLS + 1], u[SHELLS], rho[SHELLS], q[SHELLS];
    const double m = 1.0 / n;
    double t = 0;
    int i, k = 0;
    for (i = 0; i <= n; i++) {
        r[i] = sqrt((double)i / n); /* m(r) = r^2 */
        v[i] = 0;
    }
    out->peak = 0;
    for (i = 0; i < n; i++) {
        u[i] = U0;
        q[i] = 0;
        rho[i] = m / (4 * MATH_PI / 3 * (pow(r[i + 1], 3) - pow(r[i], 3)));
    }
    for (;;) {
        double dt = 0.01, thermal = 0, kinetic = 0, gravity = 0;
        for (i = 0; i < n; i++) {
            thermal += m * u[i];
            kinetic += 0.25 * m * (v[i] * v[i] + v[i + 1] * v[i + 1]);
            gravity -= m * (i + 0.5) * m / (0.5 * (r[i] + r[i + 1]));
        }
        if (thermal > out->peak) {
            out->peak = thermal;
            out->at = t;
        }
        if (t >= due(k) - 1e-9) {
            out->kinetic[k] = kinetic;
            out->thermal[k] = thermal;
            out->gravity[k] = gravity;
            if (++k == TIMES || due(k) > end + 1e-9) return;
        }
        for (i = 0; i < n; i++) {
            const double d = r[i + 1] - r[i];
            dt = fmin(dt, 0.25 * d / (sqrt(GAMMA * (GAMMA - 1) * u[i]) + 4 * fmax(v[i] - v[i + 1], 0) + 1e-9));
        }
        dt = fmin(dt, due(k) - t);
        for (i = 1; i <= n; i++) { /* the innermost edge rests; beyond the outermost there is nothing */
            const double inner = (GAMMA - 1) * rho[i - 1] * u[i - 1] + q[i - 1], outer = i < n ? (GAMMA - 1) * rho[i] * u[i] + q[i] : 0;
            const double share = i < n ? m : 0.5 * m;
            v[i] -= dt * (4 * MATH_PI * r[i] * r[i] * (outer - inner) / share + (i * m - (i < n ? 0 : 0.5 * m)) / (r[i] * r[i]));
        }
        for (i = 1; i <= n; i++) r[i] += dt * v[i];
        for (i = 0; i < n; i++) {
            const double now = m / (4 * MATH_PI / 3 * (pow(r[i + 1], 3) - pow(r[i], 3))), jump = fmax(v[i] - v[i + 1], 0);
            const double change = 1 / now - 1 / rho[i], middle = 0.5 * (now + rho[i]);
            q[i] = middle * (2 * jump * jump + 0.3 * jump * sqrt(GAMMA * (GAMMA - 1) * u[i]));
            /* du = -(P + q) d(1/rho), P = (gamma - 1) rho u in the middle of the step */
            u[i] = (u[i] * (1 - 0.5 * (GAMMA - 1) * middle * change) - q[i] * change) / (1 + 0.5 * (GAMMA - 1) * middle * change);
            rho[i] = now;
        }
        t += dt;
    }
}

static void settle(const gas *g, history *h, int k, double *total)
{
    const gas_sums s = gas_measure(g);
    h->kinetic[k] = s.kinetic;
    h->thermal[k] = s.thermal;
    h->gravity[k] = gas_potential(g);
    *total = s.total + h->gravity[k];
}
static void write_energies(const char *figures, const char *name, const history *h, int count)
{
    FILE *const data = figure_open(figures, name);
    int k;
    fprintf(data, "t,kinetic,thermal,gravity,total\n");
    for (k = 0; k < count; k++)
        fprintf(data, "%g,%.6g,%.6g,%.6g,%.6g\n", due(k), h->kinetic[k], h->thermal[k], h->gravity[k], h->kinetic[k] + h->thermal[k] + h->gravity[k]);
    figure_close(data);
}

/* The error of the peak of the thermal energy */
static double collapse(report *r, const gas_options *o, int side, int count, int finest, const history *exact)
{
    history h;
    gas g = gas_new(3, gas_ball(3, side, NULL), GAMMA);
    double first = 0, now = 0, worst = 0, least = 0;
    progress p;
    pcg32 random;
    char at[32];
    sph_index i;
    int k;
    memset(&h, 0, sizeof h);
    gas_ball(3, side, g.a + X);
    pcg32_seed(&random, 1, 1);
    for (i = 0; i < g.n; i++) {
        double q;
        for (k = 0; k < 3; k++) g.a[X + k][i] += 0.2 / side * (pcg32_uniform(&random) - 0.5);
        q = sqrt(gas_square(&g, X, i));
        for (k = 0; k < 3; k++) g.a[X + k][i] *= sqrt(q);
        g.a[M][i] = 1.0 / g.n;
        g.a[H][i] = g.eta * pow(g.a[M][i] * 2 * MATH_PI * pow(q, 1.5), 1.0 / 3);
        g.a[U][i] = U0;
    }
    g.G = 1;
    g.how = GAS_PHANTOM;
    g.conductivity = SPH_CONDUCTIVITY_WADSLEY;
    g.run = "Evrard's collapse";
    gas_start(&g);
    progress_begin(&p, g.run, o->quiet);
    for (k = 0; k < count; k++) {
        while (g.t < due(k)) {
            const gas_sums s = gas_measure(&g);
            if (s.thermal > h.peak) {
                h.peak = s.thermal;
                h.at = g.t;
            }
            gas_run(&g, fmin(due(k), g.t + gas_longest_step(&g, 0.3)), 0.3);
            progress_update(&p, g.t / due(count - 1));
        }
        settle(&g, &h, k, &now);
        if (k == 0) first = now;
        worst = fmax(worst, fabs(now - first));
        least = fmin(least, h.gravity[k]);
    }
    progress_end(&p);
    if (finest) write_energies(o->figures, "gas_evrard_particles", &h, count);
    snprintf(at, sizeof at, "%ld particles", (long)g.n);
    report_relative(report_beside(r, REPORT_THEORY), "Evrard", at, "energy at the start", U0 - 2.0 / 3, first, 0.3 / side); /* softening */
    report_absolute(report_beside(r, REPORT_THEORY), "Evrard", at, "largest change of the energy", 0, worst, 0.003);
    report_relative(report_beside(r, REPORT_THEORY), "Evrard", at, "peak of the thermal energy", exact->peak, h.peak, 2.0 / side);
    report_absolute(report_beside(r, REPORT_THEORY), "Evrard", at, "its time", exact->at, h.at, 1.4 / side);
    report_info(r, "Evrard", at, "least energy of gravity", least);
    report_absolute(report_beside(r, REPORT_THEORY), "Evrard", at, "momentum: the error of the tree", 0, gas_measure(&g).momentum, 5e-3);
    gas_close(&g);
    return fabs(h.peak / exact->peak - 1);
}

int main(int argc, char **argv)
{
    static report r;
    static history exact, coarse;
    const gas_options o = gas_begin(argc, argv, &r, "gas_evrard", "The collapse of a cold ball of gas.", "5575 particles in addition, to t = 3");
    static const int side[3] = {5, 7, 11};
    const int levels = o.full ? 3 : 2, count = o.full ? TIMES : 31, last = count - 1;
    double error[3], least = 0;
    int k;
    shells(SHELLS, due(last), &exact);
    shells(SHELLS / 2, due(last), &coarse);
    write_energies(o.figures, "gas_evrard_shells", &exact, count);
    for (k = 0; k < count; k++) least = fmin(least, exact.gravity[k]);
    report_section(&r, "The solution in one dimension");
    report_relative(report_beside(&r, REPORT_THEORY), "shells", "400", "energy at the start", U0 - 2.0 / 3, exact.thermal[0] + exact.gravity[0], 0.005);
    report_absolute(report_beside(&r, REPORT_THEORY), "shells", "400", "change of the energy to the end", 0,
                    exact.thermal[last] + exact.kinetic[last] + exact.gravity[last] - exact.thermal[0] - exact.gravity[0], 0.02);
    report_relative(report_beside(&r, REPORT_THEORY), "shells", "200 beside 400", "peak of the thermal energy", exact.peak, coarse.peak, 0.02);
    report_info(&r, "shells", "400", "least energy of gravity", least);
    report_section(&r, "Particles");
    for (k = 0; k < levels; k++) {
        error[k] = collapse(&r, &o, side[k], count, k == levels - 1, &exact);
        if (k)
            report_range(&r, "Evrard", "finer / coarser", "error of the peak of the thermal energy", (double)NAN, error[k] / error[k - 1], 0.3, 0.95);
    }
    return report_close(&r) ? 1 : 0;
}
