/* SPDX-License-Identifier: MIT
 *
 * sph.h - the toolkit: kernels (sph_kernels.h), operators (sph_ops.h) and, here, neighbour lists on the caller's memory. Include this one, or sph_ops.h if
 * your code has neighbour lists already. Copy the three headers next to each other; there is nothing to build.
 *
 *     sph_points x = sph_points_separate(n, px, py, 0);
 *     void *work = malloc(sph_neighbors_workspace(n));
 *     int64_t pairs;
 *     sph_neighbors_count(2, x, radius, work, start, &pairs);                    fills start[0 ... n]
 *     index = malloc((size_t)pairs * sizeof *index);
 *     sph_neighbors_fill(2, x, radius, work, start, index, pairs);
 *
 * INDEX
 *   size_t    sph_neighbors_workspace(n)                                           bytes of workspace for n particles; 0 if n < 1 or too large
 *   sph_index sph_neighbors_count(dim, points, radius, work, start, pairs)         cells into work, row starts into start, number of pairs into *pairs
 *   sph_index sph_neighbors_fill(dim, points, radius, work, start, index, capacity)  the rows: all j != i with |x_i - x_j| < radius, in both rows i and j
 */
#ifndef SPH_H
#define SPH_H

#include "sph_ops.h"
#if SPH_VERSION != 100
#error "sph.h and sph_ops.h are of different releases"
#endif

#if !SPH_OPENCL

/* Particles are sorted into square cells, at least `radius` wide and no more than there are particles, so that memory and time are linear in n however large and empty the
   domain is. Workspace: the grid, the first slot of every cell (n + 1), the particles by cell (n). */
typedef struct sphi_grid {
    sph_vec low, inverse_width;
    sph_index cells[3];
} sphi_grid;

#define SPHI_INDEX_MAX ((((int64_t)1 << (8 * sizeof(sph_index) - 2)) - 1) * 2 + 1)

SPH_FN size_t sph_neighbors_workspace(sph_index n)
{
    if (n < 1 || (uint64_t)n > (SIZE_MAX - sizeof(sphi_grid)) / sizeof(sph_index) / 2 - 1) return 0;
    return sizeof(sphi_grid) + (2 * (size_t)n + 1) * sizeof(sph_index);
}

SPH_FN sph_index sphi_cell_of(sph_real x, sph_real low, sph_real inverse_width, sph_index cells)
{
    const sph_real c = (x - low) * inverse_width;
    return c < (sph_real)cells ? (sph_index)c : cells - 1;
}
SPH_FN size_t sphi_cell(int dim, const sphi_grid *g, sph_vec p)
{
    size_t c = (size_t)sphi_cell_of(p.x, g->low.x, g->inverse_width.x, g->cells[0]);
    if (dim > 1) c += (size_t)g->cells[0] * (size_t)sphi_cell_of(p.y, g->low.y, g->inverse_width.y, g->cells[1]);
    if (dim > 2) c += (size_t)g->cells[0] * (size_t)g->cells[1] * (size_t)sphi_cell_of(p.z, g->low.z, g->inverse_width.z, g->cells[2]);
    return c;
}

/* cells along an axis: as many as fit, but no more than `most`. A little wider than `radius`, by the rounding of a cell's number, so that no pair is two cells apart. */
SPH_FN sph_index sphi_axis(sph_real low, sph_real high, sph_real radius, sph_index most, sph_real *inverse_width)
{
    const sph_real ratio = (high - low) / radius, fit = ratio / (SPH_R(1) + SPH_R(8) * SPH_EPSILON * ratio);
    const sph_index cells = fit < (sph_real)most ? (fit < SPH_R(1) ? 1 : (sph_index)fit) : most;
    *inverse_width = high > low ? (sph_real)cells / (high - low) : SPH_R(0);
    return cells;
}

SPH_FN int sphi_check_neighbors(int dim, sph_points x, sph_real radius, const void *work, const sph_index *start)
{
    sph_index i;
    if (dim < 1 || dim > 3) return SPH_ERROR_DIM;
    if (!x.x || (dim > 1 && !x.y) || (dim > 2 && !x.z) || !work || !start) return SPH_ERROR_NULL;
    if (x.stride < 1 || sph_neighbors_workspace(x.n) == 0) return SPH_ERROR_COUNT;
    if (!sphi_finite(radius) || !(radius > SPH_R(0))) return SPH_ERROR_H;
    if (!SPH_CHECK) return 0;
    for (i = 0; i < x.n; i++) {
        const sph_vec p = sphi_point(dim, x, i);
        if (!sphi_finite(p.x) || !sphi_finite(p.y) || !sphi_finite(p.z)) return SPH_ERROR_POSITION;
    }
    return 0;
}

/* Calls nothing and stores nothing but, if index is not null, the neighbours of i; returns how many there are. */
SPH_FN sph_index sphi_neighbors_row(int dim, sph_points x, sph_real radius, const sphi_grid *g, const sph_index *first, const sph_index *member, sph_index i,
                                    sph_index *index)
{
    const sph_vec p = sphi_point(dim, x, i);
    const sph_index cx = sphi_cell_of(p.x, g->low.x, g->inverse_width.x, g->cells[0]);
    const sph_index cy = dim > 1 ? sphi_cell_of(p.y, g->low.y, g->inverse_width.y, g->cells[1]) : 0;
    const sph_index cz = dim > 2 ? sphi_cell_of(p.z, g->low.z, g->inverse_width.z, g->cells[2]) : 0;
    const sph_index x0 = cx > 0 ? cx - 1 : 0, x1 = cx + 1 < g->cells[0] ? cx + 1 : g->cells[0] - 1;
    sph_index y, z, count = 0;
    for (z = cz > 0 ? cz - 1 : 0; z <= cz + 1 && z < g->cells[2]; z++)
        for (y = cy > 0 ? cy - 1 : 0; y <= cy + 1 && y < g->cells[1]; y++) {
            const size_t row = (size_t)g->cells[0] * ((size_t)z * (size_t)g->cells[1] + (size_t)y);
            sph_index m;
            for (m = first[row + (size_t)x0]; m < first[row + (size_t)x1 + 1]; m++) {
                const sph_index j = member[m];
                if (j == i || !(sph_length(dim, sph_subtract(dim, p, sphi_point(dim, x, j))) < radius)) continue;
                if (index) index[count] = j;
                count++;
            }
        }
    return count;
}

/* Sorts the particles into cells and counts. Returns 0 or a negative sph_error; SPH_ERROR_CAPACITY if there are more pairs than an sph_index counts (*pairs is right
   even then). Nothing is written on other errors. */
SPH_FN sph_index sph_neighbors_count(int dim, sph_points x, sph_real radius, void *work, sph_index *start, int64_t *pairs)
{
    const int error = sphi_check_neighbors(dim, x, radius, work, start);
    sphi_grid *const g = (sphi_grid *)work;
    sph_index *first, *member, i, most;
    sph_vec high;
    int64_t total = 0;
    size_t cells, c;
    if (error) return error;
    if (!pairs) return SPH_ERROR_NULL;
    first = (sph_index *)(void *)(g + 1);
    member = first + (size_t)x.n + 1;
    g->low = high = sphi_point(dim, x, 0);
    for (i = 1; i < x.n; i++) {
        const sph_vec p = sphi_point(dim, x, i);
        if (p.x < g->low.x) g->low.x = p.x;
        if (p.y < g->low.y) g->low.y = p.y;
        if (p.z < g->low.z) g->low.z = p.z;
        if (p.x > high.x) high.x = p.x;
        if (p.y > high.y) high.y = p.y;
        if (p.z > high.z) high.z = p.z;
    }
    /* at most n cells: the n-th root of n along each axis when the domain is larger than that */
    most = 1;
    while (dim == 1 ? most < x.n : dim == 2 ? (int64_t)(most + 1) * (most + 1) <= x.n : (int64_t)(most + 1) * (most + 1) * (most + 1) <= x.n) {
        if (dim == 1) most = x.n;
        else most++;
    }
    g->inverse_width.y = g->inverse_width.z = SPH_R(0);
    g->cells[0] = sphi_axis(g->low.x, high.x, radius, most, &g->inverse_width.x);
    g->cells[1] = dim > 1 ? sphi_axis(g->low.y, high.y, radius, most, &g->inverse_width.y) : 1;
    g->cells[2] = dim > 2 ? sphi_axis(g->low.z, high.z, radius, most, &g->inverse_width.z) : 1;
    cells = (size_t)g->cells[0] * (size_t)g->cells[1] * (size_t)g->cells[2];

    for (c = 0; c <= cells; c++) first[c] = 0;
    for (i = 0; i < x.n; i++) first[sphi_cell(dim, g, sphi_point(dim, x, i)) + 1]++;
    for (c = 0; c < cells; c++) first[c + 1] += first[c];
    for (i = x.n - 1; i >= 0; i--) { /* downwards from each cell's end; first[c + 1] comes to stand at the start of cell c ... */
        const size_t cell = sphi_cell(dim, g, sphi_point(dim, x, i));
        member[--first[cell + 1]] = i;
    }
    for (c = 0; c < cells; c++) first[c] = first[c + 1]; /* ... and moves back */
    first[cells] = x.n;

    for (i = 0; i < x.n; i++) {
        start[i] = (sph_index)(total < SPHI_INDEX_MAX ? total : SPHI_INDEX_MAX);
        total += sphi_neighbors_row(dim, x, radius, g, first, member, i, 0);
    }
    *pairs = total;
    if (total > SPHI_INDEX_MAX) return SPH_ERROR_CAPACITY;
    start[x.n] = (sph_index)total;
    return 0;
}

/* Fills the rows that sph_neighbors_count has laid out, with the same arguments. Returns 0 or a negative sph_error: SPH_ERROR_CAPACITY if index holds fewer than
   start[n] entries; nothing is written then. */
SPH_FN sph_index sph_neighbors_fill(int dim, sph_points x, sph_real radius, const void *work, const sph_index *start, sph_index *index, int64_t capacity)
{
    const int error = sphi_check_neighbors(dim, x, radius, work, start);
    const sphi_grid *const g = (const sphi_grid *)work;
    const sph_index *first, *member;
    sph_index i;
    if (error) return error;
    if (!index && start[x.n] > 0) return SPH_ERROR_NULL;
    if (capacity < start[x.n]) return SPH_ERROR_CAPACITY;
    first = (const sph_index *)(const void *)(g + 1);
    member = first + (size_t)x.n + 1;
    if (index)
        for (i = 0; i < x.n; i++) sphi_neighbors_row(dim, x, radius, g, first, member, i, index + start[i]);
    return 0;
}

#endif /* !SPH_OPENCL */

#endif /* SPH_H */

/*
 * MIT License
 *
 * Copyright (c) 2026 the sph.h authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy
 * of this software and associated documentation files (the "Software"), to deal
 * in the Software without restriction, including without limitation the rights
 * to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
 * copies of the Software, and to permit persons to whom the Software is
 * furnished to do so, subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all
 * copies or substantial portions of the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
 * IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
 * FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
 * AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
 * LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
 * OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
 * SOFTWARE.
 */
