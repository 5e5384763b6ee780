/* SPDX-License-Identifier: MIT
 *
 * lists.cl - neighbour lists made on a device, and a sweep on them: a counting sort of the sources into
 * cells, then the lengths of the rows, then the rows. The formulas of the grid are those of sph.h;
 * host_opencl_lists.c calls these kernels in their order. Cells that follow each other in x follow each other
 * in memory. The particles of a cell are put in ascending order, so that rows do not depend on the order of
 * atomics.
 */
#if !SPH_SINGLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define SPH_CHECK 0
#include "sph.h"

/* The same on the host: numbers only. Along a periodic axis `count` cells fill the box. */
typedef struct cells {
    sph_real low[3], inverse_width[3], box[3];
    int count[3], dim;
} cells;

sph_vec wrapped(cells g, sph_vec p)
{
    p.x = sph_grid_wrap(p.x, g.low[0], g.box[0]);
    p.y = sph_grid_wrap(p.y, g.low[1], g.box[1]);
    p.z = sph_grid_wrap(p.z, g.low[2], g.box[2]);
    return p;
}
int cell_of(cells g, int axis, sph_real x)
{
    return axis < g.dim ? (int)sph_grid_cell(x, g.low[axis], g.inverse_width[axis], g.count[axis]) : 0;
}
__kernel void count(int n, cells g, __global const sph_real *x, __global const sph_real *y,
                    __global const sph_real *z, __global int *bucket, __global int *place,
                    __global int *first)
{
    const int i = (int)get_global_id(0);
    if (i < n) {
        const sph_vec p = wrapped(g, sphi_point(g.dim, sph_points_separate(n, x, y, z), i));
        const int b =
            (cell_of(g, 2, p.z) * g.count[1] + cell_of(g, 1, p.y)) * g.count[0] + cell_of(g, 0, p.x);
        bucket[i] = b;
        place[i] = atomic_inc(&first[b + 1]);
    }
}
/* a[0] = 0, and a[k] becomes the sum of a[1] ... a[k]: one work group, of which each item has its share */
__kernel void scan(int n, __global int *a, __local int *part)
{
    const int items = (int)get_local_size(0), me = (int)get_local_id(0);
    const int from = (int)((long)n * me / items), to = (int)((long)n * (me + 1) / items);
    int sum = 0, k;
    for (k = from; k < to; k++) sum += a[k + 1];
    part[me] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (sum = 0, k = 0; k < me; k++) sum += part[k];
    if (me == 0) a[0] = 0;
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
    for (k = from; k < to; k++) a[k + 1] = sum += a[k + 1];
}
__kernel void put(int n, __global const int *bucket, __global const int *place, __global const int *first,
                  __global int *member)
{
    const int i = (int)get_global_id(0);
    if (i < n) member[first[bucket[i]] + place[i]] = i;
}
__kernel void order(int buckets, __global const int *first, __global int *member)
{
    const int b = (int)get_global_id(0);
    if (b < buckets) {
        int i, j;
        for (i = first[b] + 1; i < first[b + 1]; i++) {
            const int v = member[i];
            for (j = i; j > first[b] && member[j - 1] > v; j--) member[j] = member[j - 1];
            member[j] = v;
        }
    }
}

/* The cells from x - reach to x + reach; along a periodic axis they may lie outside of the box. */
void range(cells g, int axis, sph_real x, sph_real reach, int *from, int *to)
{
    *from = *to = 0;
    if (axis >= g.dim) return;
    if (g.box[axis] > SPH_R(0)) {
        /* rounding differs from image to image */
        const sph_real more = reach + SPH_R(16) * SPH_EPSILON * (g.box[axis] + fabs(g.low[axis]));
        *from = (int)sph_grid_cell_periodic(x - more, g.low[axis], g.inverse_width[axis]);
        *to = (int)sph_grid_cell_periodic(x + more, g.low[axis], g.inverse_width[axis]);
        if (*to - *from >= g.count[axis]) { /* each cell once: the minimum image is in one of them */
            *from = 0;
            *to = g.count[axis] - 1;
        }
    } else {
        *from = cell_of(g, axis, x - reach);
        *to = cell_of(g, axis, x + reach);
    }
}
int in_box(cells g, int axis, int c)
{
    return axis < g.dim && g.box[axis] > SPH_R(0) ? c - (int)sph_grid_image(g.count[axis], c) * g.count[axis]
                                                  : c;
}
/* The row of target i by a criterion of sph.h: its length, and its entries where out is not null. R: the
   support radius of each source, of which none is above `largest`. */
int row(int i, int criterion, sph_real largest, cells g, sph_points points, __global const sph_real *R,
        __global const int *first, __global const int *member, __global int *out)
{
    const sph_vec p = wrapped(g, sphi_point(g.dim, points, i));
    const sph_real reach = sph_grid_pair_radius(criterion, R[i], largest);
    int x0, x1, y0, y1, z0, z1, cx, cy, cz, s, found = 0;
    range(g, 0, p.x, reach, &x0, &x1);
    range(g, 1, p.y, reach, &y0, &y1);
    range(g, 2, p.z, reach, &z0, &z1);
    for (cz = z0; cz <= z1; cz++)
        for (cy = y0; cy <= y1; cy++) {
            const int base = (in_box(g, 2, cz) * g.count[1] + in_box(g, 1, cy)) * g.count[0];
            for (cx = x0; cx <= x1;) { /* once, or twice where the row passes the end of the box */
                const int c = in_box(g, 0, cx), cells_left = x1 - cx + 1;
                const int stretch = cells_left < g.count[0] - c ? cells_left : g.count[0] - c;
                for (s = first[base + c]; s < first[base + c + stretch]; s++) {
                    const int j = member[s];
                    const sph_vec d = sphi_separation(g.dim, points, sphi_point(g.dim, points, i),
                                                      sphi_point(g.dim, points, j));
                    const sph_real pair = sph_grid_pair_radius(criterion, R[i], R[j]);
                    if (j == i || !(sph_dot(g.dim, d, d) < pair * pair)) continue;
                    if (out) out[found] = j;
                    found++;
                }
                cx += stretch;
            }
        }
    return found;
}
sph_points points_of(cells g, int n, __global const sph_real *x, __global const sph_real *y,
                     __global const sph_real *z)
{
    return sph_points_periodic(sph_points_separate(n, x, y, z), g.box[0], g.box[1], g.box[2]);
}
__kernel void lengths(int n, int n_total, int criterion, sph_real largest, cells g,
                      __global const sph_real *x, __global const sph_real *y, __global const sph_real *z,
                      __global const sph_real *R, __global const int *first, __global const int *member,
                      __global int *start)
{
    const int i = (int)get_global_id(0);
    if (i < n)
        start[i + 1] = row(i, criterion, largest, g, points_of(g, n_total, x, y, z), R, first, member, 0);
}
__kernel void rows(int n, int n_total, int criterion, sph_real largest, cells g, __global const sph_real *x,
                   __global const sph_real *y, __global const sph_real *z, __global const sph_real *R,
                   __global const int *first, __global const int *member, __global const int *start,
                   __global int *index)
{
    const int i = (int)get_global_id(0);
    if (i < n)
        row(i, criterion, largest, g, points_of(g, n_total, x, y, z), R, first, member, index + start[i]);
}
__kernel void density(int n, int n_total, cells g, __global const sph_real *x, __global const sph_real *y,
                      __global const sph_real *z, __global const int *start, __global const int *index,
                      __global const sph_real *h, __global const sph_real *m, __global sph_real *rho)
{
    const int i = (int)get_global_id(0);
    const sph_list list = {start, index};
    const sph_cloud all =
        sph_cloud_of(points_of(g, n_total, x, y, z), list, sph_scalars_array(h), sph_scalars_none());
    if (i < n)
        sph_density_summation(SPH_WENDLAND_C2, 3, sph_cloud_range(all, i, i + 1), sph_scalars_array(m),
                              sph_scalar_out_array(rho, 0));
}
