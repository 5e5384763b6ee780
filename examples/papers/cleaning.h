/* SPDX-License-Identifier: MIT
 *
 * cleaning.h - what the drivers of the divergence-cleaning paper (Tricco & Price 2012, 7th SPHERIC workshop)
 * with a free boundary share: the disc of 1976 particles, and rows for the values of an independent trial.
 */
#ifndef CLEANING_H
#define CLEANING_H

#include <math.h>

#include "../common/figure.h"
#include "../common/host.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/random.h"
#include "../common/report.h"
#include "../common/statistics.h"

#define CLEANING_SPACING 0.04 /* of the lattice: the unit disc then has 1976 particles */
#define CLEANING_ETA 1.2      /* h in spacings */

/* The nodes of a lattice, in the middle of its cells, within the unit disc or sphere; counts only where p[0] is null. */
static inline int cleaning_ball(int dim, double dx, double *const p[3])
{
    const int side = 2 * (int)ceil(1 / dx);
    int n = 0, i, a;
    for (i = 0; i < (dim == 2 ? side * side : side * side * side); i++) {
        const int at[3] = {i % side, i / side % side, i / side / side};
        double r2 = 0;
        for (a = 0; a < dim; a++) r2 += pow((at[a] + 0.5 - side / 2) * dx, 2);
        if (r2 >= 1) continue;
        for (a = 0; a < dim && p[0]; a++) p[a][n] = (at[a] + 0.5 - side / 2) * dx;
        n++;
    }
    return n;
}

/* A value of an independent implementation with the same settings (the trial) beside ours, which may differ by a factor: the paper prints none. */
static inline void cleaning_trial(report *r, const char *item, const char *at, const char *quantity, double trial, double measured, double factor)
{
    report_factor(report_beside(r, REPORT_REGRESSION), item, at, quantity, trial, measured, factor);
}

#endif
