/* SPDX-License-Identifier: MIT
 *
 * tree.h - a tree of particles in three dimensions, for gravity and for neighbours whose smoothing lengths differ by orders of magnitude. The host's side of self-gravitating gas.
 *
 * A balanced k-d tree: a node is a run of particles, halved at the median along the longest side of its bounds, until a run has at most TREE_LEAF of them. The particles are stored in the order of the
 * tree (tree_order says which goes where; the host permutes its arrays), so that a node needs no list of its members. The children of node k are 2 k + 1 and 2 k + 2.
 * Gravity: monopole and quadrupole of a node whose radius about its centre of mass is less than theta times the distance to the nearest place of the targets (Barnes & Hut 1986, Nature 324, 446, with
 * the bound of Salmon & Warren 1994, J. Comput. Phys. 111, 136, for a leaf of targets at once), and that is out of reach of both softenings, where the force is Newton's. Else its halves; from leaf to
 * leaf all pairs: Newton's, or those of a list by sph_gravity_pair. Forces of nodes are not antisymmetric: momentum is conserved to their error only.
 */
#ifndef TREE_H
#define TREE_H

#include <math.h>

#include "host.h"

enum { TREE_LEAF = 8, TREE_DEPTH = 26 };

typedef struct tree_node {
    sph_index first, last;
    double middle[3], half[3]; /* bounds of the particles: middle and half of the sides */
    double reach;              /* the longest of their radii: of the search, or of the softening */
    double m, x[3], size;      /* mass, its centre, the largest distance of a particle from there */
    double q[6];               /* xx, xy, yy, xz, yz, zz of sum m (3 d d - d^2), d from the centre */
} tree_node;

typedef struct tree {
    sph_index n;
    int depth, nodes, leaves;
    tree_node *node;
    sph_index *order; /* order[slot]: the particle that belongs there */
    sph_index room;   /* particles that the memory is for */
} tree;

static inline void tree_free(tree *t)
{
    free(t->node);
    free(t->order);
    memset(t, 0, sizeof *t);
}

/* Puts the smaller half by p in front: order[first ... middle - 1] <= order[middle] <= the rest. */
static inline void tree_halve(sph_index *order, const double *p, sph_index first, sph_index middle, sph_index last)
{
    while (last - first > 1) {
        const double pivot = p[order[first + (last - first) / 2]];
        sph_index i = first, j = last - 1;
        while (i <= j) {
            while (p[order[i]] < pivot) i++;
            while (p[order[j]] > pivot) j--;
            if (i <= j) {
                const sph_index o = order[i];
                order[i++] = order[j];
                order[j--] = o;
            }
        }
        if (middle <= j) last = j + 1;
        else if (middle >= i) first = i;
        else return;
    }
}

static inline void tree_split(tree *t, const double *const *p, int k, sph_index first, sph_index last, int depth)
{
    tree_node *const node = &t->node[k];
    int c, longest = 0;
    node->first = first;
    node->last = last;
    for (c = 0; c < 3; c++) {
        double low = p[c][t->order[first]], high = low;
        sph_index i;
        for (i = first + 1; i < last; i++) {
            const double x = p[c][t->order[i]];
            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        node->middle[c] = 0.5 * (low + high);
        node->half[c] = 0.5 * (high - low);
        if (node->half[c] > node->half[longest]) longest = c;
    }
    if (depth == t->depth) return;
    tree_halve(t->order, p[longest], first, first + (last - first) / 2, last);
    tree_split(t, p, 2 * k + 1, first, first + (last - first) / 2, depth + 1);
    tree_split(t, p, 2 * k + 2, first + (last - first) / 2, last, depth + 1);
}
/* The order of the particles, and the bounds of the nodes. All zeros to begin with; positions must be finite. */
static inline void tree_order(tree *t, sph_index n, const double *x, const double *y, const double *z)
{
    const double *const p[3] = {x, y, z};
    sph_index i;
    t->n = n;
    for (t->depth = 0; t->depth < TREE_DEPTH && (n >> t->depth) >= TREE_LEAF; t->depth++) {}
    t->leaves = 1 << t->depth;
    t->nodes = 2 * t->leaves - 1;
    if (n > t->room) {
        t->room = n;
        t->order = (sph_index *)need(t->order, (size_t)n, sizeof *t->order);
        t->node = (tree_node *)need(t->node, (size_t)t->nodes, sizeof *t->node);
    }
    for (i = 0; i < n; i++) t->order[i] = i;
    tree_split(t, p, 0, 0, n, 0);
}

/* From here on the particles are in the order of the tree. radius: of each particle */
static inline void tree_reach(tree *t, const double *radius)
{
    int k;
    for (k = t->nodes - 1; k >= 0; k--) {
        tree_node *const node = &t->node[k];
        sph_index i;
        if (k < t->leaves - 1) node->reach = fmax(t->node[2 * k + 1].reach, t->node[2 * k + 2].reach);
        else
            for (i = node->first, node->reach = 0; i < node->last; i++) node->reach = fmax(node->reach, radius[i]);
    }
}
/* Masses, centres, quadrupoles: of leaves from the particles, of others from the halves, by the parallel-axis theorem */
static inline void tree_add_quadrupole(tree_node *node, double m, const double *d)
{
    const double d2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    node->q[0] += m * (3 * d[0] * d[0] - d2);
    node->q[1] += m * 3 * d[0] * d[1];
    node->q[2] += m * (3 * d[1] * d[1] - d2);
    node->q[3] += m * 3 * d[0] * d[2];
    node->q[4] += m * 3 * d[1] * d[2];
    node->q[5] += m * (3 * d[2] * d[2] - d2);
}
static inline void tree_moments(tree *t, const double *x, const double *y, const double *z, const double *m)
{
    int k, c, s;
    for (k = t->nodes - 1; k >= 0; k--) {
        tree_node *const node = &t->node[k];
        const tree_node *const half = k < t->leaves - 1 ? &t->node[2 * k + 1] : NULL;
        double d[3], corner = 0;
        sph_index i;
        memset(node->q, 0, sizeof node->q);
        memset(node->x, 0, sizeof node->x);
        node->m = node->size = 0;
        if (half) {
            for (s = 0; s < 2; s++) {
                node->m += half[s].m;
                for (c = 0; c < 3; c++) node->x[c] += half[s].m * half[s].x[c];
            }
        } else {
            for (i = node->first; i < node->last; i++) {
                const double p[3] = {x[i], y[i], z[i]};
                node->m += m[i];
                for (c = 0; c < 3; c++) node->x[c] += m[i] * p[c];
            }
        }
        for (c = 0; c < 3; c++) node->x[c] /= node->m;
        if (half) {
            for (s = 0; s < 2; s++) {
                double apart = 0;
                for (c = 0; c < 6; c++) node->q[c] += half[s].q[c];
                for (c = 0; c < 3; c++) {
                    d[c] = half[s].x[c] - node->x[c];
                    apart += d[c] * d[c];
                }
                tree_add_quadrupole(node, half[s].m, d);
                node->size = fmax(node->size, half[s].size + sqrt(apart));
            }
            for (c = 0; c < 3; c++) corner += pow(node->half[c] + fabs(node->x[c] - node->middle[c]), 2);
            node->size = fmin(node->size, sqrt(corner)); /* both are bounds */
        } else {
            for (i = node->first; i < node->last; i++) {
                d[0] = x[i] - node->x[0];
                d[1] = y[i] - node->x[1];
                d[2] = z[i] - node->x[2];
                tree_add_quadrupole(node, m[i], d);
                node->size = fmax(node->size, sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
            }
        }
    }
}

/* without a branch, so that loops vectorise */
static inline double tree_larger(double a, double b) { return 0.5 * (a + b + fabs(a - b)); }
static inline double tree_positive(double a) { return 0.5 * (a + fabs(a)); }

/* The square of a lower bound of the distance between a node and a box of this middle and these half sides (a node, or a place), short of it by more than rounding. box: periodic length of all axes, of
   which `inverse` is the inverse; both 0: open */
static inline double tree_gap2(const tree_node *a, const double *middle, const double *half, double box, double inverse)
{
    double d2 = 0;
    int c;
    for (c = 0; c < 3; c++) {
        const double d = a->middle[c] - middle[c], gap = tree_positive(fabs(d - box * (double)(int)(d * inverse + copysign(0.5, d))) - a->half[c] - half[c]);
        d2 += gap * gap;
    }
    return d2 * (1 - 1e-12);
}
static const double tree_point[3] = {0, 0, 0}; /* the half sides of a place */

/* ---- neighbours ---- */

/* Rows that grow; all zeros to begin with */
typedef struct tree_rows {
    sph_index *start, *index;
    int64_t pairs, capacity;
} tree_rows;

/* All j with r < max(radius_i, radius_j), not i itself, for each particle, after tree_reach with these radii. The box holds all particles; at most half of it is a radius. */
static inline void tree_neighbours(const tree *t, const double *x, const double *y, const double *z, const double *radius, double box, tree_rows *rows)
{
    const size_t n = (size_t)t->n;
    double *const room = (double *)need(NULL, 5 * n, sizeof *room);
    sph_index *const which = (sph_index *)need(NULL, n, sizeof *which);
    double *const cx = room, *const cy = room + n, *const cz = room + 2 * n, *const cr = room + 3 * n, *const beyond = room + 4 * n;
    const double inverse = box > 0 ? 1 / box : 0;
    int leaf;
    rows->start = (sph_index *)need(rows->start, n + 1, sizeof *rows->start);
    rows->start[0] = 0;
    rows->pairs = 0;
    for (leaf = t->leaves - 1; leaf < t->nodes; leaf++) {
        const tree_node *const group = &t->node[leaf];
        int stack[2 * TREE_DEPTH + 2], depth = 0;
        sph_index found = 0, i, j;
        int64_t needed;
        stack[depth++] = 0;
        while (depth > 0) {
            const int k = stack[--depth];
            const tree_node *const node = &t->node[k];
            if (tree_gap2(group, node->middle, node->half, box, inverse) >= pow(tree_larger(group->reach, node->reach), 2)) continue;
            if (k < t->leaves - 1) {
                stack[depth++] = 2 * k + 2;
                stack[depth++] = 2 * k + 1;
            } else
                for (j = node->first; j < node->last; j++) {
                    const double p[3] = {x[j], y[j], z[j]}, wide = tree_larger(group->reach, radius[j]);
                    cx[found] = p[0];
                    cy[found] = p[1];
                    cz[found] = p[2];
                    cr[found] = radius[j] * radius[j];
                    which[found] = j;
                    found += tree_gap2(group, p, tree_point, box, inverse) < wide * wide;
                }
        }
        needed = rows->pairs + (int64_t)found * (group->last - group->first) + 1;
        if (needed > rows->capacity) {
            rows->capacity = 2 * needed;
            rows->index = (sph_index *)need(rows->index, (size_t)rows->capacity, sizeof *rows->index);
        }
        for (i = group->first; i < group->last; i++) {
            sph_index *const row = rows->index + rows->pairs;
            const double xi = x[i], yi = y[i], zi = z[i], own = radius[i] * radius[i];
            sph_index count = 0;
            SPH_EACH(j, 0, found) {
                double dx = xi - cx[j], dy = yi - cy[j], dz = zi - cz[j];
                dx -= box * (double)(int)(dx * inverse + copysign(0.5, dx));
                dy -= box * (double)(int)(dy * inverse + copysign(0.5, dy));
                dz -= box * (double)(int)(dz * inverse + copysign(0.5, dz));
                beyond[j] = dx * dx + dy * dy + dz * dz - tree_larger(own, cr[j]);
            }
            for (j = 0; j < found; j++) { /* in range or not is anybody's guess: no branch */
                row[count] = which[j];
                count += (sph_index)((beyond[j] < 0) & (which[j] != i));
            }
            rows->pairs += count;
            rows->start[i + 1] = (sph_index)rows->pairs;
        }
    }
    free(room);
    free(which);
    if (rows->pairs > INT32_MAX) {
        fprintf(stderr, "more pairs than a list can number\n");
        exit(2);
    }
}
static inline void tree_rows_free(tree_rows *rows)
{
    free(rows->start);
    free(rows->index);
    memset(rows, 0, sizeof *rows);
}

/* ---- gravity ---- */

/* What a leaf of targets sees: nodes by their moments, and particles */
typedef struct tree_seen {
    double *node[10], *point[5]; /* m, x, y, z and the six of the quadrupole; m, x, y, z and the square of the support of its softening */
    sph_index nodes, points;
} tree_seen;
static inline void tree_see(const tree *t, const tree_node *group, double theta, double support, const double *const *p, tree_seen *s)
{
    int stack[2 * TREE_DEPTH + 2], depth = 0, c;
    sph_index i;
    s->nodes = s->points = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const int k = stack[--depth];
        const tree_node *const node = &t->node[k];
        if (node->size * node->size < theta * theta * tree_gap2(group, node->x, tree_point, 0, 0) &&
            tree_gap2(group, node->middle, node->half, 0, 0) > pow(tree_larger(group->reach, node->reach), 2)) {
            s->node[0][s->nodes] = node->m;
            for (c = 0; c < 3; c++) s->node[1 + c][s->nodes] = node->x[c];
            for (c = 0; c < 6; c++) s->node[4 + c][s->nodes] = node->q[c];
            s->nodes++;
        } else if (k < t->leaves - 1) {
            stack[depth++] = 2 * k + 2;
            stack[depth++] = 2 * k + 1;
        } else
            for (i = node->first; i < node->last; i++, s->points++) {
                for (c = 0; c < 4; c++) s->point[c][s->points] = p[c][i];
                s->point[4][s->points] = support * support * p[4][i] * p[4][i];
            }
    }
}
/* Accelerations by all particles of those in the leaves first <= leaf < last (of t->leaves), isolated, after tree_reach with the supports of h and tree_moments. list: all pairs within the larger support,
   and more do no harm. A leaf's result does not depend on which others are asked for, so that threads may share them. */
static inline void tree_gravity(sph_kernel kernel, const tree *t, int first, int last, double theta, const double *x, const double *y, const double *z,
                                const double *m, const double *h, double G, sph_list list, double *ax, double *ay, double *az)
{
    const double *const p[5] = {m, x, y, z, h};
    const double support = sph_kernel_support_ratio(kernel);
    const size_t n = (size_t)(t->n > t->nodes ? t->n : t->nodes);
    double *const room = (double *)need(NULL, 15 * n, sizeof *room);
    tree_seen s;
    int leaf, c;
    for (c = 0; c < 10; c++) s.node[c] = room + (size_t)c * n;
    for (c = 0; c < 5; c++) s.point[c] = room + (size_t)(10 + c) * n;
    for (leaf = first; leaf < last; leaf++) {
        const tree_node *const group = &t->node[t->leaves - 1 + leaf];
        sph_index i, j, k;
        tree_see(t, group, theta, support, p, &s);
        for (i = group->first; i < group->last; i++) {
            const double xi = x[i], yi = y[i], zi = z[i], own = support * support * h[i] * h[i];
            double sx = 0, sy = 0, sz = 0;
            SPH_SUM(j, 0, s.nodes, sx, sy, sz) {
                const double dx = xi - s.node[1][j], dy = yi - s.node[2][j], dz = zi - s.node[3][j];
                const double per_r2 = 1 / (dx * dx + dy * dy + dz * dz), per_r = sqrt(per_r2), per_r5 = per_r2 * per_r2 * per_r;
                const double qx = s.node[4][j] * dx + s.node[5][j] * dy + s.node[7][j] * dz, qy = s.node[5][j] * dx + s.node[6][j] * dy + s.node[8][j] * dz,
                             qz = s.node[7][j] * dx + s.node[8][j] * dy + s.node[9][j] * dz;
                /* -m d / r^3 + Q d / r^5 - 5/2 (d Q d) d / r^7 */
                const double along = s.node[0][j] * per_r2 * per_r + 2.5 * (dx * qx + dy * qy + dz * qz) * per_r5 * per_r2;
                sx += qx * per_r5 - along * dx;
                sy += qy * per_r5 - along * dy;
                sz += qz * per_r5 - along * dz;
            }
            SPH_SUM(j, 0, s.points, sx, sy, sz) { /* Newton, where no softening reaches */
                const double dx = xi - s.point[1][j], dy = yi - s.point[2][j], dz = zi - s.point[3][j];
                const double r2 = dx * dx + dy * dy + dz * dz, limit = tree_larger(own, s.point[4][j]);
                const double outside = 0.5 + copysign(0.5, r2 - limit), safe = r2 + (1 - outside) * limit,
                             along = outside * s.point[0][j] / (safe * sqrt(safe));
                sx -= along * dx;
                sy -= along * dy;
                sz -= along * dz;
            }
            for (k = list.start[i]; k < list.start[i + 1]; k++) {
                const sph_index o = list.index[k];
                const double dx = xi - x[o], dy = yi - y[o], dz = zi - z[o], r2 = dx * dx + dy * dy + dz * dz, other = support * support * h[o] * h[o];
                const double along = r2 - tree_larger(own, other) < 0 ? m[o] * sph_gravity_pair(kernel, sqrt(r2), h[i], h[o]) : 0;
                sx -= along * dx;
                sy -= along * dy;
                sz -= along * dz;
            }
            ax[i] = G * sx;
            ay[i] = G * sy;
            az[i] = G * sz;
        }
    }
    free(room);
}

#endif
