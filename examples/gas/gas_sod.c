/* SPDX-License-Identifier: MIT
 *
 * gas_sod.c - Sod's shock tube in one dimension, by one conductivity and one switch of the viscosity after the
 * other, beside the exact solution.
 *
 *     cc -O2 -o gas_sod examples/gas/gas_sod.c -lm
 *     gas_sod -out DIR       (-h for help)
 *
 * rho, P = 1, 1 for x < 0 and 1/8, 0.1 for x > 0, at rest, gamma = 1.4, t = 0.2; 450 particles of one mass on
 * |x| < 1, whose ends are open. L1 is the integral of |error| over |x| < 0.5,
 * by the volumes of the particles. The blip is the range of P / P* within 0.06 of the contact, and the overshoot the
 * largest u there over the exact one. The figures to be met are those of an independent trial. Sod 1978, JCP 27, 1.
 */
#include "../common/figure.h"
#include "../common/options.h"
#include "gas.h"

static const double G = 1.4;
/* velocity difference across the wave of one side, at the pressure p of the contact: Toro 2009, (4.6), (4.7) */
static double wave(double p, double rho, double P0)
{
    const double c = sqrt(G * P0 / rho);
    if (p > P0) return (p - P0) * sqrt(2 / ((G + 1) * rho) / (p + (G - 1) / (G + 1) * P0));
    return 2 * c / (G - 1) * (pow(p / P0, (G - 1) / (2 * G)) - 1);
}
static double star_p, star_v, left_rho, right_rho;
static void solve(void)
{
    double low = 0.1, high = 1;
    int i;
    for (i = 0; i < 100; i++) {
        star_p = 0.5 * (low + high);
        if (wave(star_p, 1, 1) + wave(star_p, 0.125, 0.1) > 0) high = star_p;
        else low = star_p;
    }
    star_v = wave(star_p, 0.125, 0.1);
    left_rho = pow(star_p, 1 / G);
    right_rho = 0.125 * (star_p / 0.1 + (G - 1) / (G + 1)) / ((G - 1) / (G + 1) * star_p / 0.1 + 1);
}
/* rho, v, P at x / t */
static void exact(double s, double *q)
{
    const double c = sqrt(G), shock = star_v * right_rho / (right_rho - 0.125), tail = star_v - sqrt(G * star_p / left_rho);
    q[0] = s < -c ? 1 : s < star_v ? left_rho : s < shock ? right_rho : 0.125;
    q[1] = s < -c || s > shock ? 0 : star_v;
    q[2] = s < -c ? 1 : s < shock ? star_p : 0.1;
    if (s > -c && s < tail) {
        const double a = 2 / (G + 1) - (G - 1) / (G + 1) * s / c;
        q[0] = pow(a, 2 / (G - 1));
        q[1] = 2 / (G + 1) * (c + s);
        q[2] = pow(a, 2 * G / (G - 1));
    }
}

typedef struct trial {
    const char *name;
    int conductivity;
    gas_switch how;
    double least, most;
    double rho, v, p, low, high, overshoot; /* figures of an independent trial */
} trial;

int main(int argc, char **argv)
{
    static const trial trials[] = {
        {"no conductivity", SPH_CONDUCTIVITY_NONE, GAS_CONSTANT, 1, 1, .00643, .02017, .00761, .897, 1.108, 1.062},
        {"Price", SPH_CONDUCTIVITY_PRICE, GAS_CONSTANT, 1, 1, .00747, .02107, .00735, .965, 1.034, 1.012},
        {"|w|", SPH_CONDUCTIVITY_WADSLEY, GAS_CONSTANT, 1, 1, .00672, .02057, .00757, .927, 1.072, 1.035},
        {"Price, Morris & Monaghan", SPH_CONDUCTIVITY_PRICE, GAS_MORRIS, 0.1, 1, .00771, .02277, .00763, .968, 1.031, .999},
        {"Price, Cullen & Dehnen", SPH_CONDUCTIVITY_PRICE, GAS_CULLEN, 0, 2, .00765, .02696, .00762, .969, 1.046, .994},
        {"Price, Phantom", SPH_CONDUCTIVITY_PRICE, GAS_PHANTOM, 0, 1, .00760, .02087, .00756, .966, 1.034, 1.011}};
    const char *out = ".", *figures = ".";
    const option_spec specs[] = {{"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
                                 {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
                                 THREADS_OPTION};
    static report r;
    size_t k;
    options_parse(argc, argv, "Sod's shock tube, by one conductivity and switch after the other.", specs, 3);
    report_open(&r, "gas_sod", out);
    figure_folder(figures, "gas_sod");
    solve();
    report_absolute(report_beside(&r, REPORT_OTHERS), "exact solution", "", "pressure of the contact", 0.30313, star_p, 1e-5);
    for (k = 0; k < sizeof trials / sizeof trials[0]; k++) {
        const trial *const t = &trials[k];
        const double dx = 0.0025;
        gas g = gas_new(1, 450, G);
        double error[3] = {0, 0, 0}, low = 9, high = 0, hot = 0, top = 0, elsewhere = 0, before;
        const double shock = 0.2 * star_v * right_rho / (right_rho - 0.125), contact = 0.2 * star_v, u_right = star_p / (G - 1) / right_rho,
                     u_left = star_p / (G - 1) / left_rho;
        sph_index i, others = 0;
        for (i = 0; i < g.n; i++) {
            const int right = i >= 400;
            g.a[X][i] = right ? 8 * dx * (i - 400 + 0.5) : -1 + dx * (i + 0.5);
            g.a[M][i] = dx;
            g.a[U][i] = right ? 0.1 / (G - 1) / 0.125 : 1 / (G - 1);
            g.a[H][i] = 1.2 * (right ? 8 * dx : dx);
        }
        g.conductivity = t->conductivity;
        g.how = t->how;
        g.alpha[0] = t->least;
        g.alpha[1] = t->most;
        before = gas_energy(&g);
        gas_start(&g);
        gas_run(&g, 0.2, 0.3);
        memcpy(g.a[PU], g.a[U], (size_t)g.n * sizeof(double));
        for (i = 0; i < g.n; i++) {
            const double x = g.a[X][i], p = (G - 1) * g.a[RHO][i] * g.a[U][i];
            double q[3];
            if (fabs(x) > 0.5) continue;
            exact(x / 0.2, q);
            error[0] += g.a[VOLUME][i] * fabs(g.a[RHO][i] - q[0]);
            error[1] += g.a[VOLUME][i] * fabs(g.a[VX][i] - q[1]);
            error[2] += g.a[VOLUME][i] * fabs(p - q[2]);
            if (fabs(x - contact) < 0.06) {
                low = fmin(low, p / star_p);
                high = fmax(high, p / star_p);
                hot = fmax(hot, g.a[U][i] / fmax(u_right, u_left));
            }
            if (fabs(x - shock) < 0.05) top = fmax(top, g.a[ALPHA][i]);
            else {
                elsewhere += g.a[ALPHA][i];
                others++;
            }
        }
        report_section(&r, t->name);
        report_relative(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "L1 of rho", t->rho, error[0], 0.03);
        if (t->how == GAS_CULLEN) /* the trial's alpha stays at .33 at the shock, ours rises to .77; its code is not known */
            report_not_reproduced(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "L1 of v", t->v, error[1],
                                  "5 % above the trial, whose alpha at the shock is .33: where the two differ is not known");
        else report_relative(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "L1 of v", t->v, error[1], 0.03);
        report_relative(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "L1 of P", t->p, error[2], 0.03);
        report_relative(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "least P at the contact / exact", t->low, low, 0.01);
        report_relative(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "largest P at the contact / exact", t->high, high, 0.01);
        report_relative(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "largest u at the contact / exact", t->overshoot, hot, 0.01);
        report_absolute(report_beside(&r, REPORT_THEORY), t->name, "450 particles", "change of the energy", 0, gas_energy(&g) / before - 1, 1e-4);
        report_info(&r, t->name, "450 particles", "largest alpha at the shock", top);
        report_info(&r, t->name, "450 particles", "mean alpha elsewhere", elsewhere / others);
        if (t->conductivity == SPH_CONDUCTIVITY_PRICE && t->how == GAS_CONSTANT)
            report_range(report_beside(&r, REPORT_THEORY), t->name, "450 particles", "blip of P: below 4 %", 1, high, 0.96, 1.04);
        if (t->conductivity == SPH_CONDUCTIVITY_NONE)
            report_range(report_beside(&r, REPORT_REGRESSION), t->name, "450 particles", "blip of P: above 9 %", t->high, high, 1.09, 1.2);
        {
            static const char *const file[] = {"none", "price", "w", "morris", "cullen", "phantom"};
            char name[64];
            FILE *data;
            snprintf(name, sizeof name, "gas_sod_%s", file[k]);
            data = figure_open(figures, name);
            fprintf(data, "x,rho,v,P,alpha,exact rho,exact v,exact P\n");
            for (i = 0; i < g.n; i++) {
                double q[3];
                exact(g.a[X][i] / 0.2, q);
                fprintf(data, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", g.a[X][i], g.a[RHO][i], g.a[VX][i], (G - 1) * g.a[RHO][i] * g.a[U][i],
                        g.a[ALPHA][i], q[0], q[1], q[2]);
            }
            figure_close(data);
        }
        gas_close(&g);
    }
    return report_close(&r) ? 1 : 0;
}
