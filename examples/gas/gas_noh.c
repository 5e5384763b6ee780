/* SPDX-License-Identifier: MIT
 *
 * gas_noh.c - Noh's implosion (1987, JCP 72, 78): cold gas falls onto a point, a shock runs out.
 *
 *     cc -O2 -o gas_noh examples/gas/gas_noh.c -lm
 *     gas_noh -out DIR [-full]       (-h for help)
 *
 * rho = 1, v = -1 towards the middle, P = 0 (u = 1e-6 here), gamma = 5/3, to t = 0.6. The shock is exact at r = t / 3;
 * behind it rho = 4^dim, P = 4^dim / 3, at rest; before it rho = (1 + t / r)^(dim - 1). A line, and a disc of radius
 * 1 on a square lattice; -full: the disc twice as fine, and a ball. Their rim is open: nothing that happens there
 * arrives, because sound is slow. rho and v behind the shock are means over 0.06 < r < 0.15, where the shock has
 * passed long ago. In the middle u is too large and rho too small: wall heating, of which conductivity takes
 * a part: the least rho for r < 0.06 is named. rho behind the shock has to be exact to 5 spacings of the start.
 */
#include "gas_cases.h"

static const double END = 0.6;
typedef struct trial {
    const char *name, *file;
    int dim, side, conductivity; /* side: particles from the middle to the rim */
} trial;
static const trial trials[] = {{"1D, no conductivity", "1d_none", 1, 200, SPH_CONDUCTIVITY_NONE}, /* each beside the one after it */
                               {"1D, Price", "1d", 1, 200, SPH_CONDUCTIVITY_PRICE},
                               {"2D, no conductivity", "2d_none", 2, 32, SPH_CONDUCTIVITY_NONE},
                               {"2D, Price", "2d", 2, 32, SPH_CONDUCTIVITY_PRICE},
                               {"2D, Price", "2d_64", 2, 64, SPH_CONDUCTIVITY_PRICE},
                               {"3D, Price", "3d", 3, 16, SPH_CONDUCTIVITY_PRICE}};

/* The least rho in the middle, over the exact one */
static double implosion(report *r, const gas_options *o, const trial *t)
{
    static const char *const coarse = "17256 particles are too few: the gas behind the shock is 3 spacings of the start thick, and the open rim comes near";
    const double exact = pow(4, t->dim), shock = END / 3;
    gas g = gas_new(t->dim, gas_ball(t->dim, t->side, NULL), 5.0 / 3);
    double rho = 0, v = 0, in = 0, middle = 1, before, out = 0, error = 0, front = 0, energy;
    char setting[32], name[64];
    FILE *data;
    sph_index i;
    gas_ball(t->dim, t->side, g.a + X);
    for (i = 0; i < g.n; i++) {
        const double q = sqrt(gas_square(&g, X, i));
        int k;
        for (k = 0; k < t->dim; k++) g.a[VX + k][i] = -g.a[X + k][i] / q;
        g.a[M][i] = pow(1.0 / t->side, t->dim);
        g.a[H][i] = g.eta / t->side;
        g.a[U][i] = 1e-6;
    }
    g.run = t->name;
    g.conductivity = t->conductivity;
    gas_start(&g);
    energy = gas_measure(&g).total;
    gas_run_shown(&g, END, 0.3, o->quiet);
    snprintf(name, sizeof name, "gas_noh_%s", t->file);
    data = figure_open(o->figures, name);
    fprintf(data, "r,rho,v,u,exact rho\n");
    for (i = 0; i < g.n; i++) {
        const double q = sqrt(gas_square(&g, X, i)), V = g.a[M][i] / g.a[RHO][i];
        const double speed = (g.a[VX][i] * g.a[X][i] + g.a[VY][i] * g.a[Y][i] + g.a[VZ][i] * g.a[Z][i]) / q;
        const double there = q < shock ? exact : pow(1 + END / q, t->dim - 1);
        if (q < 0.4) fprintf(data, "%.6g,%.6g,%.6g,%.6g,%.6g\n", q, g.a[RHO][i], speed, g.a[U][i], there);
        if (q > 0.06 && q < 0.15) {
            rho += V * g.a[RHO][i];
            v += V * fabs(speed);
            in += V;
        }
        if (q < 0.06) middle = fmin(middle, g.a[RHO][i] / exact);
        if (q > 0.26 && q < 0.34) {
            error += V * fabs(g.a[RHO][i] / there - 1);
            out += V;
        }
        if (q < 0.4 && speed > -0.5) front = fmax(front, q); /* those that have been stopped */
    }
    figure_close(data);
    before = gas_measure(&g).total / energy - 1;
    snprintf(setting, sizeof setting, "%ld particles", (long)g.n);
    report_section(r, t->name);
    if (t->dim == 3) {
        report_not_reproduced(report_beside(r, REPORT_THEORY), t->name, setting, "rho behind the shock", exact, rho / in, coarse);
        report_not_reproduced(report_beside(r, REPORT_THEORY), t->name, setting, "|v| behind the shock", 0, v / in, coarse);
        report_not_reproduced(report_beside(r, REPORT_THEORY), t->name, setting, "before the shock: mean error of rho", 0, error / out, coarse);
    } else {
        report_relative(report_beside(r, REPORT_THEORY), t->name, setting, "rho behind the shock", exact, rho / in, t->dim == 1 ? 0.01 : 5.0 / t->side);
        report_absolute(report_beside(r, REPORT_THEORY), t->name, setting, "|v| behind the shock", 0, v / in, 0.02);
        report_absolute(report_beside(r, REPORT_THEORY), t->name, setting, "before the shock: mean error of rho", 0, error / out, 0.05);
    }
    report_absolute(report_beside(r, REPORT_THEORY), t->name, setting, "the shock is at r", shock, front, 1.5 / t->side);
    report_info(r, t->name, setting, "least rho for r < 0.06 / exact: wall heating", middle);
    report_absolute(report_beside(r, REPORT_THEORY), t->name, setting, "change of the energy", 0, before, 1e-3);
    report_absolute(report_beside(r, REPORT_THEORY), t->name, setting, "momentum", 0, gas_measure(&g).momentum, 1e-12);
    gas_close(&g);
    return middle;
}

int main(int argc, char **argv)
{
    static report r;
    const gas_options o = gas_begin(argc, argv, &r, "gas_noh", "Noh's implosion, with and without conductivity.",
                                    "a disc twice as fine, and a ball, in addition");
    size_t k;
    double middle[6];
    for (k = 0; k < 4 + (o.full ? 2 : 0); k++) middle[k] = implosion(&r, &o, &trials[k]);
    report_section(&r, "Wall heating");
    report_range(&r, "1D", "Price / no conductivity", "least rho for r < 0.06", (double)NAN, middle[1] / middle[0], 1.05, 3);
    report_range(&r, "2D", "Price / no conductivity", "least rho for r < 0.06", (double)NAN, middle[3] / middle[2], 1.05, 3);
    return report_close(&r) ? 1 : 0;
}
