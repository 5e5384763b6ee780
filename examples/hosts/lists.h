/* SPDX-License-Identifier: MIT
 *
 * lists.h - neighbour lists made on a device, the same source for OpenCL (lists.cl, vortex.cl) and CUDA
 * (host_cuda_vortex.cu): a counting sort of the sources into cells, then the lengths of the rows, then the rows.
 * The formulas of the grid are those of sph.h. Cells that follow each other in x follow each other in memory. The
 * particles of a cell are put in ascending order, so that rows do not depend on the order of atomics.
 *
 * A host runs, in this order and with one item for each of:
 *     nothing (cells), count (sources), scan (one group: cells), put (sources), order (cells), lengths (targets),
 *     scan (one group: targets), rows (targets)
 * Include sph.h first, with SPH_CHECK 0 on a device. A host includes this file for `cells` only.
 */
#ifndef HOSTS_LISTS_H
#define HOSTS_LISTS_H

/* The cells. Numbers only. Along a periodic axis (box > 0) `count` cells fill the box. */
typedef struct cells {
    sph_real low[3], inverse_width[3], box[3];
    int count[3], dim;
} cells;
enum { GROUP = 64, SCANNERS = 256 }; /* items of a group; of the one that scans */

/* Of the unit square or cube: the width at least, and a quarter of it along x, where cells follow each other. In an
   open one what is beyond belongs to the last cells. */
SPH_FN cells cells_of(int dim, sph_real width, int periodic)
{
    cells g;
    int k;
    g.dim = dim;
    for (k = 0; k < 3; k++) {
        g.low[k] = SPH_R(0);
        g.box[k] = periodic && k < dim ? SPH_R(1) : SPH_R(0);
        g.count[k] = k < dim ? (int)(SPH_R(k == 0 ? 4 : 1) / width) : 1;
        if (g.count[k] < 1) g.count[k] = 1;
        g.inverse_width[k] = (sph_real)g.count[k];
    }
    return g;
}
SPH_FN int cells_all(cells g) { return g.count[0] * g.count[1] * g.count[2]; }

/* The coordinates of n points, axis by axis: all of x, then all of y ... */
SPH_FN sph_points cells_points(cells g, int n, const SPH_GLOBAL sph_real *x)
{
    const SPH_GLOBAL sph_real *const y = x + (g.dim > 1 ? n : 0), *const z = x + (g.dim > 2 ? 2 * n : 0);
    return sph_points_periodic(sph_points_separate(n, x, y, z), g.box[0], g.box[1], g.box[2]);
}

#if SPH_OPENCL || defined(__CUDACC__)
#if SPH_OPENCL
#define DEVICE_KERNEL __kernel void
#define DEVICE_SHARED __local
#define DEVICE_ITEM ((int)get_global_id(0))
#define DEVICE_TOGETHER barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE)
#define DEVICE_NEXT(p) atomic_inc(p)
#else
#define DEVICE_KERNEL __global__ void
#define DEVICE_SHARED __shared__
#define DEVICE_ITEM (int(blockIdx.x * blockDim.x + threadIdx.x))
#define DEVICE_TOGETHER __syncthreads()
#define DEVICE_NEXT(p) atomicAdd(p, 1)
#endif

SPH_FN sph_vec cells_wrapped(cells g, sph_vec p)
{
    p.x = sph_grid_wrap(p.x, g.low[0], g.box[0]);
    p.y = sph_grid_wrap(p.y, g.low[1], g.box[1]);
    p.z = sph_grid_wrap(p.z, g.low[2], g.box[2]);
    return p;
}
SPH_FN int cells_at(cells g, int axis, sph_real x)
{
    return axis < g.dim ? (int)sph_grid_cell(x, g.low[axis], g.inverse_width[axis], g.count[axis]) : 0;
}
DEVICE_KERNEL nothing(int buckets, SPH_GLOBAL int *first)
{
    const int b = DEVICE_ITEM;
    if (b < buckets) first[b + 1] = 0;
}
DEVICE_KERNEL count(int n, cells g, const SPH_GLOBAL sph_real *x, SPH_GLOBAL int *bucket, SPH_GLOBAL int *place,
                    SPH_GLOBAL int *first)
{
    const int i = DEVICE_ITEM;
    if (i < n) {
        const sph_vec p = cells_wrapped(g, sphi_point(g.dim, cells_points(g, n, x), i));
        const int b = (cells_at(g, 2, p.z) * g.count[1] + cells_at(g, 1, p.y)) * g.count[0] + cells_at(g, 0, p.x);
        bucket[i] = b;
        place[i] = DEVICE_NEXT(&first[b + 1]);
    }
}
/* a[0] = 0, and a[k] becomes the sum of a[1] ... a[k]: one group of SCANNERS items, of which each has its share */
DEVICE_KERNEL scan(int n, SPH_GLOBAL int *a)
{
    DEVICE_SHARED int part[SCANNERS];
    const int me = DEVICE_ITEM, share = (n + SCANNERS - 1) / SCANNERS;
    const int from = me * share < n ? me * share : n, to = from + share < n ? from + share : n;
    int sum = 0, k;
    for (k = from; k < to; k++) sum += a[k + 1];
    part[me] = sum;
    DEVICE_TOGETHER;
    for (sum = 0, k = 0; k < me; k++) sum += part[k];
    if (me == 0) a[0] = 0;
    for (k = from; k < to; k++) a[k + 1] = sum += a[k + 1];
}
DEVICE_KERNEL put(int n, const SPH_GLOBAL int *bucket, const SPH_GLOBAL int *place, const SPH_GLOBAL int *first,
                  SPH_GLOBAL int *member)
{
    const int i = DEVICE_ITEM;
    if (i < n) member[first[bucket[i]] + place[i]] = i;
}
DEVICE_KERNEL order(int buckets, const SPH_GLOBAL int *first, SPH_GLOBAL int *member)
{
    const int b = DEVICE_ITEM;
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
SPH_FN void cells_range(cells g, int axis, sph_real x, sph_real reach, int *from, int *to)
{
    *from = *to = 0;
    if (axis >= g.dim) return;
    if (g.box[axis] > SPH_R(0)) {
        /* rounding differs from image to image */
        const sph_real more = reach + SPH_R(16) * SPH_EPSILON * (g.box[axis] + SPHI_ABS(g.low[axis]));
        *from = (int)sph_grid_cell_periodic(x - more, g.low[axis], g.inverse_width[axis]);
        *to = (int)sph_grid_cell_periodic(x + more, g.low[axis], g.inverse_width[axis]);
        if (*to - *from >= g.count[axis]) { /* each cell once: the minimum image is in one of them */
            *from = 0;
            *to = g.count[axis] - 1;
        }
    } else {
        *from = cells_at(g, axis, x - reach);
        *to = cells_at(g, axis, x + reach);
    }
}
SPH_FN int cells_in_box(cells g, int axis, int c)
{
    return axis < g.dim && g.box[axis] > SPH_R(0) ? c - (int)sph_grid_image(g.count[axis], c) * g.count[axis] : c;
}
/* The row of target i by a criterion of sph.h: its length, and its entries where out is not null. Behind the
   coordinates of the n sources stand their support radii, of which none is above `largest`. */
SPH_FN int cells_row(int i, int n, int criterion, sph_real largest, cells g, const SPH_GLOBAL sph_real *x,
                     const SPH_GLOBAL int *first, const SPH_GLOBAL int *member, SPH_GLOBAL int *out)
{
    const sph_points points = cells_points(g, n, x);
    const SPH_GLOBAL sph_real *const radius = x + g.dim * n;
    const sph_vec at = sphi_point(g.dim, points, i), p = cells_wrapped(g, at);
    const sph_real reach = sph_grid_pair_radius(criterion, radius[i], largest);
    int x0, x1, y0, y1, z0, z1, cx, cy, cz, s, found = 0;
    cells_range(g, 0, p.x, reach, &x0, &x1);
    cells_range(g, 1, p.y, reach, &y0, &y1);
    cells_range(g, 2, p.z, reach, &z0, &z1);
    for (cz = z0; cz <= z1; cz++)
        for (cy = y0; cy <= y1; cy++) {
            const int base = (cells_in_box(g, 2, cz) * g.count[1] + cells_in_box(g, 1, cy)) * g.count[0];
            for (cx = x0; cx <= x1;) { /* once, or twice where the row passes the end of the box */
                const int c = cells_in_box(g, 0, cx), cells_left = x1 - cx + 1;
                const int stretch = cells_left < g.count[0] - c ? cells_left : g.count[0] - c;
                for (s = first[base + c]; s < first[base + c + stretch]; s++) {
                    const int j = member[s];
                    const sph_vec d = sphi_separation(g.dim, points, at, sphi_point(g.dim, points, j));
                    const sph_real pair = sph_grid_pair_radius(criterion, radius[i], radius[j]);
                    if (j == i || !(sph_dot(g.dim, d, d) < pair * pair)) continue;
                    if (out) out[found] = j;
                    found++;
                }
                cx += stretch;
            }
        }
    return found;
}
DEVICE_KERNEL lengths(int n, int n_total, int criterion, cells g, const SPH_GLOBAL sph_real *x,
                      const SPH_GLOBAL sph_real *largest, const SPH_GLOBAL int *first, const SPH_GLOBAL int *member,
                      SPH_GLOBAL int *start)
{
    const int i = DEVICE_ITEM;
    if (i < n) start[i + 1] = cells_row(i, n_total, criterion, *largest, g, x, first, member, 0);
}
/* Nothing is written if index has no room: its capacity is less than start[n]. */
DEVICE_KERNEL rows(int n, int n_total, int criterion, cells g, const SPH_GLOBAL sph_real *x,
                   const SPH_GLOBAL sph_real *largest, const SPH_GLOBAL int *first, const SPH_GLOBAL int *member,
                   const SPH_GLOBAL int *start, int capacity, SPH_GLOBAL int *index)
{
    const int i = DEVICE_ITEM;
    if (i < n && start[n] <= capacity) cells_row(i, n_total, criterion, *largest, g, x, first, member, index + start[i]);
}
#endif

#endif
