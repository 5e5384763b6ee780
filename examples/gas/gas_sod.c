/* SPDX-License-Identifier: MIT
 *
 * gas_sod.c - Sod's shock tube in one dimension, by one conductivity and one switch of the viscosity after the
 * other, and in two and three dimensions, beside the exact solution.
 *
 *     cc -O2 -o gas_sod examples/gas/gas_sod.c -lm
 *     gas_sod -out DIR [-full]       (-h for help)
 *
 * The case: gas_riemann.h. In one dimension 450 particles of one mass on |x| < 1, whose ends are open; beyond it the
 * lattices of tube.h. L1 is the integral of |error| over |x| < 0.5, by the volumes of the particles. The blip is the
 * range of P / P* within 0.06 of the contact, and the overshoot the largest u there over the exact one. The figures
 * to be met in one dimension are those of an independent trial. In two and three dimensions the particles are moved off
 * their lattice at random by up to a twentieth of a spacing. What happens without stands beside it: rows that are
 * stretched along the tube stay rows, and behind the rarefaction P is 3 % (2D), or a third (3D) too large, at any resolution.
 */
#include "gas_cases.h"
#include "gas_riemann.h"

typedef struct trial {
    const char *name, *file;
    int conductivity;
    gas_switch how;
    double least, most;
    double rho, v, p, low, high, overshoot; /* figures of an independent trial */
} trial;
static const trial trials[] = {
    {"no conductivity", "none", SPH_CONDUCTIVITY_NONE, GAS_CONSTANT, 1, 1, .00643, .02017, .00761, .897, 1.108, 1.062},
    {"Price", "price", SPH_CONDUCTIVITY_PRICE, GAS_CONSTANT, 1, 1, .00747, .02107, .00735, .965, 1.034, 1.012},
    {"|w|", "w", SPH_CONDUCTIVITY_WADSLEY, GAS_CONSTANT, 1, 1, .00672, .02057, .00757, .927, 1.072, 1.035},
    {"Price, Morris & Monaghan", "morris", SPH_CONDUCTIVITY_PRICE, GAS_MORRIS, 0.1, 1, .00771, .02277, .00763, .968, 1.031, .999},
    {"Price, Cullen & Dehnen", "cullen", SPH_CONDUCTIVITY_PRICE, GAS_CULLEN, 0, 2, .00765, .02696, .00762, .969, 1.046, .994},
    {"Price, Phantom", "phantom", SPH_CONDUCTIVITY_PRICE, GAS_PHANTOM, 0, 1, .00760, .02087, .00756, .966, 1.034, 1.011}};

/* In one dimension */
static void line(report *r, const char *figures, const riemann *s, const trial *t)
{
    const char *const at = "450 particles";
    const double dx = 0.0025, G = sod_tube.gamma, contact = SOD_END * s->v, shock = SOD_END * s->shock,
                 u = s->P / (G - 1) / fmin(s->rho[0], s->rho[1]);
    gas g = gas_new(1, 450, G);
    double low = 9, high = 0, hot = 0, top = 0, elsewhere = 0, before;
    sod_errors e;
    char name[64];
    sph_index i, others = 0;
    for (i = 0; i < g.n; i++) {
        const int right = i >= 400;
        g.a[X][i] = right ? 8 * dx * (i - 400 + 0.5) : -1 + dx * (i + 0.5);
        g.a[M][i] = dx;
        g.a[U][i] = sod_tube.P[right] / (G - 1) / sod_tube.rho[right];
        g.a[H][i] = GAS_ETA * (right ? 8 * dx : dx);
    }
    g.run = t->name;
    g.conductivity = t->conductivity;
    g.how = t->how;
    g.alpha[0] = t->least;
    g.alpha[1] = t->most;
    gas_start(&g);
    before = gas_measure(&g).total;
    gas_run(&g, SOD_END, 0.3);
    e = sod_compare(&g, s);
    for (i = 0; i < g.n; i++) {
        double q[SOD_QUANTITIES];
        if (fabs(g.a[X][i]) > 0.5) continue;
        sod_state(&g, i, q);
        if (fabs(g.a[X][i] - contact) < 0.06) {
            low = fmin(low, q[SOD_P] / s->P);
            high = fmax(high, q[SOD_P] / s->P);
            hot = fmax(hot, g.a[U][i] / u);
        }
        if (fabs(g.a[X][i] - shock) < 0.05) top = fmax(top, g.a[ALPHA][i]);
        else {
            elsewhere += g.a[ALPHA][i];
            others++;
        }
    }
    report_section(r, t->name);
    report_relative(report_beside(r, REPORT_REGRESSION), t->name, at, "L1 of rho", t->rho, e.l1[SOD_RHO], 0.03);
    if (t->how == GAS_CULLEN)
        report_not_reproduced(report_beside(r, REPORT_REGRESSION), t->name, at, "L1 of v", t->v, e.l1[SOD_V],
                              "5 % above the trial: where the two differ is not known");
    else report_relative(report_beside(r, REPORT_REGRESSION), t->name, at, "L1 of v", t->v, e.l1[SOD_V], 0.03);
    report_relative(report_beside(r, REPORT_REGRESSION), t->name, at, "L1 of P", t->p, e.l1[SOD_P], 0.03);
    report_relative(report_beside(r, REPORT_REGRESSION), t->name, at, "least P at the contact / exact", t->low, low, 0.01);
    report_relative(report_beside(r, REPORT_REGRESSION), t->name, at, "largest P at the contact / exact", t->high, high, 0.01);
    report_relative(report_beside(r, REPORT_REGRESSION), t->name, at, "largest u at the contact / exact", t->overshoot, hot, 0.01);
    report_absolute(report_beside(r, REPORT_THEORY), t->name, at, "change of the energy", 0, gas_measure(&g).total / before - 1, 1e-4);
    report_info(r, t->name, at, "largest alpha at the shock", top);
    report_info(r, t->name, at, "mean alpha elsewhere", elsewhere / others);
    if (t->conductivity == SPH_CONDUCTIVITY_PRICE && t->how == GAS_CONSTANT)
        report_range(report_beside(r, REPORT_THEORY), t->name, at, "blip of P: below 4 %", 1, high, 0.96, 1.04);
    if (t->conductivity == SPH_CONDUCTIVITY_NONE)
        report_range(report_beside(r, REPORT_REGRESSION), t->name, at, "blip of P: above 9 %", t->high, high, 1.09, 1.2);
    snprintf(name, sizeof name, "gas_sod_%s", t->file);
    sod_write(&g, s, figures, name);
    gas_close(&g);
}

/* In two or three, at a spacing of 1 / columns on the left */
static sod_errors tube_run(report *r, const gas_options *o, const riemann *s, int dim, int columns, double jitter, char at[64])
{
    const char *const item = dim == 2 ? "2D" : "3D";
    tube c = sod_tube;
    gas g;
    char name[64];
    double before;
    sod_errors e;
    int k;
    c.jitter = jitter;
    g = tube_new(&c, dim, 1.0 / columns);
    snprintf(at, 64, "dx = 1/%d, %ld particles%s", columns, (long)g.free, jitter > 0 ? "" : ", lattice");
    g.run = item;
    g.conductivity = SPH_CONDUCTIVITY_PRICE;
    gas_start(&g);
    before = gas_measure(&g).total;
    gas_run_shown(&g, SOD_END, 0.3, o->quiet);
    e = sod_compare(&g, s);
    for (k = 0; k < SOD_QUANTITIES; k++) {
        char what[32];
        snprintf(what, sizeof what, "L1 of %s", sod_name[k]);
        report_info(r, item, at, what, e.l1[k]);
    }
    /* those at the ends hold still, whoever pushes them */
    report_absolute(report_beside(r, REPORT_THEORY), item, at, "change of the energy", 0, gas_measure(&g).total / before - 1, 1e-3);
    report_info(r, item, at, "largest v across the tube", e.across);
    snprintf(name, sizeof name, "gas_sod_%dd%s", dim, jitter > 0 ? "" : "_lattice");
    sod_write(&g, s, o->figures, name);
    gas_close(&g);
    return e;
}
static void tubes(report *r, const gas_options *o, const riemann *s, int dim, const int *columns, int count)
{
    const char *const item = dim == 2 ? "2D" : "3D";
    sod_errors e, last = {{0, 0, 0}, {{0, 0, 0}, {0, 0, 0}}, 0};
    char at[64], what[64];
    int level, k, side;
    report_section(r, item);
    for (level = 0; level < count; level++) {
        e = tube_run(r, o, s, dim, columns[level], 0.1, at);
        for (k = 0; k < SOD_QUANTITIES && level; k++) { /* 1 at shocks, below it at contacts */
            snprintf(what, sizeof what, "order of L1 of %s", sod_name[k]);
            report_range(report_beside(r, REPORT_THEORY), item, at, what, 1, log(last.l1[k] / e.l1[k]) / log((double)columns[level] / columns[level - 1]), 0.4,
                         1.3);
        }
        last = e;
    }
    for (side = 0; side < 2; side++) {
        const double exact[SOD_QUANTITIES] = {s->rho[side], s->v, s->P};
        for (k = 0; k < SOD_QUANTITIES; k++) {
            snprintf(what, sizeof what, "%s %s of the contact", sod_name[k], side ? "right" : "left");
            report_relative(report_beside(r, REPORT_THEORY), item, at, what, exact[k], e.mean[side][k], 0.05);
        }
    }
    /* lattices that are compressed along the tube alone: the density is then no sum of the kernel's any more, least so of cubes */
    e = tube_run(r, o, s, dim, columns[count - 1], 0, at);
    report_range(r, item, at, "P left of the contact / exact, off by more", (double)NAN, e.mean[0][SOD_P] / s->P, dim == 2 ? 1.015 : 1.2, dim == 2 ? 1.05 : 1.5);
}

int main(int argc, char **argv)
{
    static const int columns[2][3] = {{100, 200, 400}, {32, 64, 128}};
    static report r;
    const gas_options o = gas_begin(argc, argv, &r, "gas_sod", "Sod's shock tube, by one conductivity and switch after the other; in two and three dimensions.",
                                    "dx = 1/400 in two and 1/128 in three dimensions in addition");
    const riemann s = riemann_solve();
    size_t k;
    report_absolute(report_beside(&r, REPORT_OTHERS), "exact solution", "", "pressure of the contact", 0.30313, s.P, 1e-5);
    for (k = 0; k < sizeof trials / sizeof trials[0]; k++) line(&r, o.figures, &s, &trials[k]);
    tubes(&r, &o, &s, 2, columns[0], o.full ? 3 : 2);
    tubes(&r, &o, &s, 3, columns[1], o.full ? 3 : 2);
    return report_close(&r) ? 1 : 0;
}
