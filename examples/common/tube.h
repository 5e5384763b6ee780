/* SPDX-License-Identifier: MIT
 *
 * tube.h - a shock tube in one to three dimensions: particles of one mass on lattices, 8 times as many on the left, x < 0,
 * as on the right; triangles in 2D (17 rows on the left, 6 on the right: 8 times the area each to 0.4 %, which the
 * spacing along the tube corrects), cubes of dx and 2 dx in 3D. It is periodic across. Nothing is smoothed. Particles
 * at both ends, which no wave may reach, do not move.
 */
#ifndef TUBE_H
#define TUBE_H

#include "gas.h"
#include "random.h"

typedef struct tube {
    double gamma, rho[2], P[2], B[2][2]; /* of the left and the right; B: Bx, By of each, zeros for none */
    double ends[2];                      /* of the part that moves, < 0 and > 0 */
    double jitter; /* of the particles that move, in spacings: a lattice of cubes is compressed along the tube alone, and stays so */
} tube;

/* The lattice of one side in x from 0 outwards: appends to the gas, or counts only. */
typedef struct tube_lattice {
    double dx, dy; /* along, across */
    int rows, layers, shifted;
} tube_lattice;
static inline int tube_fill(const tube *c, const tube_lattice *l, int side, double from, double to, gas *g, int at)
{
    const int first = (int)(from / l->dx + 0.5), last = (int)(to / l->dx + 0.5);
    int column, row, layer;
    for (column = first; column < last; column++)
        for (layer = 0; layer < l->layers; layer++)
            for (row = 0; row < l->rows; row++, at++)
                if (g) {
                    g->a[X][at] = (side ? 1 : -1) * (column + 0.5) * l->dx;
                    g->a[Y][at] = g->dim < 2 ? 0 : (row + (l->shifted ? 0.25 + 0.5 * (column & 1) : 0.5)) * l->dy;
                    g->a[Z][at] = g->dim < 3 ? 0 : (layer + 0.5) * l->dy;
                    g->a[U][at] = c->P[side] / ((c->gamma - 1) * c->rho[side]);
                    g->a[BX][at] = c->B[side][0];
                    g->a[BY][at] = c->B[side][1];
                    g->a[RHO][at] = c->rho[side];
                }
    return at;
}
/* dx: spacing along the tube on the left. What is beyond m, x, u, B, h is for the caller to set. */
static inline gas tube_new(const tube *c, int dim, double dx)
{
    tube_lattice l[2];
    double m;
    gas g;
    pcg32 random;
    int s, pass, n = 0, free_ones = 0;
    if (dim == 2) {
        l[0].dx = dx;
        l[0].dy = dx * 2 / sqrt(3.0);
        l[0].rows = 17;
        l[1].rows = 6;
        l[1].dy = 17 * l[0].dy / 6;
        l[1].dx = 8 * l[0].dx * l[0].dy / l[1].dy;
    } else {
        l[0].dx = l[0].dy = dx;
        l[0].rows = dim == 1 ? 1 : 12;
        l[1].rows = dim == 1 ? 1 : 6;
        l[1].dx = l[1].dy = (dim == 1 ? 8 : 2) * dx;
    }
    for (s = 0; s < 2; s++) {
        l[s].layers = dim == 3 ? l[s].rows : 1;
        l[s].shifted = dim == 2;
    }
    memset(&g, 0, sizeof g);
    for (pass = 0; pass < 2; pass++) { /* those that move come first */
        if (pass == 1) g = gas_new(dim, n, c->gamma);
        n = 0;
        for (s = 0; s < 2; s++) n = tube_fill(c, &l[s], s, 0, fabs(c->ends[s]), pass ? &g : NULL, n);
        free_ones = n;
        for (s = 0; s < 2; s++) { /* the rim's own density is too low: no one who moves must see it */
            const double zone = 8 * GAS_ETA * l[s].dy;
            n = tube_fill(c, &l[s], s, fabs(c->ends[s]), fabs(c->ends[s]) + zone, pass ? &g : NULL, n);
        }
    }
    pcg32_seed(&random, 1, 1);
    for (n = 0; n < free_ones && c->jitter > 0; n++)
        for (s = 0; s < dim; s++) g.a[X + s][n] += c->jitter * l[g.a[X][n] > 0].dx * (pcg32_uniform(&random) - 0.5);
    g.free = free_ones;
    g.box[1] = dim == 1 ? 0 : l[0].rows * l[0].dy;
    g.box[2] = dim == 3 ? g.box[1] : 0;
    m = c->rho[0] * l[0].dx * (dim == 1 ? 1 : l[0].dy) * (dim == 3 ? l[0].dy : 1);
    for (n = 0; n < g.n; n++) {
        g.a[M][n] = m;
        g.a[H][n] = GAS_ETA * pow(m / g.a[RHO][n], 1.0 / dim);
    }
    return g;
}

#endif
