/* SPDX-License-Identifier: MIT
 *
 * gas_cases.h - what the drivers of this folder share: their options, a ball of particles, and cases that
 * several of them run. The gas is that of examples/common/gas.h.
 */
#ifndef GAS_CASES_H
#define GAS_CASES_H

#include "../common/gas.h"
#include "../common/progress.h"

typedef struct gas_options {
    const char *out, *figures;
    int full, quiet;
} gas_options;
/* clang-format off */
#define GAS_OPTIONS(o, what) \
    {"out", "folder of the result table", OPTION_TEXT, &(o).out, 0, 0}, \
    {"figures", "folder of the figures' data", OPTION_TEXT, &(o).figures, 0, 0}, \
    {"full", what, OPTION_FLAG, &(o).full, 0, 0}, \
    {"quiet", "no progress on the terminal", OPTION_FLAG, &(o).quiet, 0, 0}, THREADS_OPTION
/* clang-format on */
enum { GAS_OPTION_COUNT = 5 };

/* `full`: what more particles are asked for */
static inline gas_options gas_begin(int argc, char **argv, report *r, const char *name, const char *about, const char *full)
{
    gas_options o = {".", ".", 0, 0};
    const option_spec specs[] = {GAS_OPTIONS(o, full)};
    options_parse(argc, argv, about, specs, GAS_OPTION_COUNT);
    report_open(r, name, o.out);
    figure_folder(o.figures, name);
    return o;
}

/* The nodes within the unit ball, in the middle of cells of the size 1 / side; counts only where x is null */
static inline sph_index gas_ball(int dim, int side, double *const *x)
{
    const double dx = 1.0 / side;
    const int row = 2 * side, all = dim == 1 ? row : dim == 2 ? row * row : row * row * row;
    sph_index n = 0;
    int i, k;
    for (i = 0; i < all; i++) {
        const int at[3] = {i % row, i / row % row, i / row / row};
        double p[3] = {0, 0, 0};
        for (k = 0; k < dim; k++) p[k] = (at[k] + 0.5 - side) * dx;
        if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] >= 1) continue;
        for (k = 0; k < dim && x; k++) x[k][n] = p[k];
        n++;
    }
    return n;
}

/* gas_run, with a line of progress */
static inline void gas_run_shown(gas *g, double end, double courant, int quiet)
{
    progress p;
    progress_begin(&p, g->run, quiet);
    while (g->t < end) {
        gas_run(g, fmin(end, g->t + gas_longest_step(g, courant)), courant);
        progress_update(&p, g->t / end);
    }
    progress_end(&p);
}

/* ---- Gresho's vortex (Gresho & Chan 1990, IJNMF 11, 621), rho = 1: pressure balances rotation ---- */

static inline double gresho_speed(double r) { return r < 0.2 ? 5 * r : r < 0.4 ? 2 - 5 * r : 0; }
static inline double gresho_pressure(double r)
{
    if (r < 0.2) return 5 + 12.5 * r * r;
    if (r < 0.4) return 9 + 12.5 * r * r - 20 * r + 4 * log(r / 0.2);
    return 3 + 4 * log(2.0);
}
/* side x side particles in the unit box, the vortex in its middle; gamma = 5/3. What steers the gas is for the
   caller to set before. */
static inline void gresho_start(gas *g, int side)
{
    const double dx = 1.0 / side;
    sph_index i;
    g->box[0] = g->box[1] = 1;
    for (i = 0; i < g->n; i++) {
        const double x = (i % side + 0.5) * dx - 0.5, y = (i / side + 0.5) * dx - 0.5, q = hypot(x, y);
        g->a[X][i] = x + 0.5;
        g->a[Y][i] = y + 0.5;
        g->a[VX][i] = -gresho_speed(q) * y / q;
        g->a[VY][i] = gresho_speed(q) * x / q;
        g->a[U][i] = 1.5 * gresho_pressure(q);
        g->a[M][i] = dx * dx;
        g->a[H][i] = g->eta * dx;
    }
    gas_start(g);
}

#endif
