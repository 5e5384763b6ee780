/* SPDX-License-Identifier: MIT
 *
 * clustering_plates.h - the flow between two plates, y = 0 and 1, with nu = 1: its series, and particles for it.
 * Poiseuille: body force 8, largest speed 1 in the end. Couette: the upper plate moves at speed 1. From rest.
 */
#ifndef CLUSTERING_PLATES_H
#define CLUSTERING_PLATES_H

#include "clustering.h"

static inline double plates_speed(int couette, double y, double t)
{
    double u = couette ? y : 4 * y * (1 - y);
    int n;
    for (n = 1; n < 400; n++) {
        const double k = n * clustering_pi, decay = exp(-k * k * t);
        if (decay < 1e-18) break;
        if (couette) u += 2 / k * (n % 2 ? -1 : 1) * sin(k * y) * decay;
        else if (n % 2) u -= 32 / (k * k * k) * sin(k * y) * decay;
    }
    return u;
}
static inline double plates_force(int couette) { return couette ? 0 : 8; }

enum { PLATES_COLUMNS = 8 };
/* A hexagonal lattice of f->dref, whose rows are 1 / rows apart, periodic in x; ghosts behind both plates. */
static inline void plates_fill(flow *f, int couette, int rows)
{
    const double dy = 1.0 / rows;
    const int layers = (int)(sph_kernel_support_ratio(f->kernel) * f->h / dy) + 1;
    int row, column, ghosts, i;
    f->box_x = PLATES_COLUMNS * f->dref;
    for (ghosts = 0; ghosts < 2; ghosts++)
        for (row = -layers; row < rows + layers; row++)
            for (column = 0; column < PLATES_COLUMNS; column++) {
                const double x = (column + 0.25 + 0.5 * (row % 2 != 0)) * f->dref, y = (row + 0.5) * dy;
                const int inside = row >= 0 && row < rows;
                if (!ghosts && inside) flow_add(f, x, y, 0, f->dref * dy);
                if (ghosts && !inside) {
                    i = flow_add_ghost(f, x, y, 0, f->dref * dy);
                    f->vx[i] = couette && row >= rows ? 1 : 0;
                }
            }
}
/* rms error of the speed, in the largest speed of all */
static inline double plates_error(const flow *f, int couette)
{
    double sum = 0;
    int i;
    for (i = 0; i < f->n_fluid; i++) {
        const double off = f->vx[i] - plates_speed(couette, f->y[i], f->t);
        sum += off * off / f->n_fluid;
    }
    return sqrt(sum);
}

#endif
