/* SPDX-License-Identifier: MIT
 *
 * sph.h - the whole toolkit: kernels (sph_kernels.h), operators (sph_ops.h) and, in this file, the search for
 * neighbours. Include this header, or sph_ops.h if your code already has neighbour lists. Copy the three
 * headers next to each other. There is nothing to build.
 *
 * One call finds all neighbours. You own the memory; the call says how much it needs:
 *
 *     sph_points x = sph_points_separate(n, px, py, pz);            your arrays, where they are
 *     sph_scalars radius = sph_scalars_same(&support);              support radius: sph_kernel_support(k, h)
 *     sph_neighbors found;
 *     void *memory = NULL;
 *     size_t size = 0;
 *
 *     while (sph_search(3, x, radius, SPH_GATHER, memory, size, &found) == SPH_ERROR_CAPACITY) {
 *         size = sph_search_size(3, n, found.pairs);
 *         memory = realloc(memory, size);
 *     }
 *     cloud = sph_cloud_of(x, found.list, h, volume);               what the operators take
 *
 * Do the same in each step, with the same memory; most calls then find it large enough. If one allocation is
 * to be enough, begin with room for 8, 32 or 128 pairs per particle in 1, 2 or 3 dimensions, or for more:
 * found.pairs says how many there are.
 *
 * THE SAME IN PARTS, for targets that are not sources, for other lists, and for your own layout of memory:
 *
 *     sph_query query = sph_query_of(x, SPH_GATHER, radius, 0);               what to look for
 *     work = malloc(sph_grid_workspace(3, n));
 *     sph_grid_build(3, x, radius, work, sph_grid_workspace(3, n), &grid);    sorts particles
 *     sph_grid_count(3, &grid, query, start, &pairs);                         counts: fills start[0 ... n]
 *     index = malloc((size_t)pairs * sizeof *index);
 *     sph_grid_lists(3, &grid, query, start, index, pairs, &pairs);
 *
 * Counting costs about as much as filling. So keep the memory from step to step, with some room to spare, and
 * call sph_grid_lists alone. If the room is too small, it answers SPH_ERROR_CAPACITY, and pairs is the number
 * that is needed.
 *
 * If the particles are stored in an order close to that of the grid, every sweep is faster, and lists take
 * half of the time. So sort your arrays once in a while. The order is sph_grid_permutation(&grid), or after
 * sph_search sph_grid_permutation(&found.grid):
 *
 *     sph_permute(n, sph_grid_permutation(&grid), px, 1, sorted); ...     each array of yours, positions too
 *     sph_grid_renumber(&grid);                                for lists of this grid; or search again
 *
 * Lists can be kept for several steps: build them with the radius + a skin, and build them again when
 * sph_rebuild_due says so. A workspace may be used again for any cloud that is not larger. What is given as
 * void * may be aligned in any way, as an array of char is; arrays of numbers must be aligned as their type
 * asks. A grid, and the lists of sph_search, point into that memory: if it is moved or copied, search again.
 * A cloud may be empty: with 0 particles, or no targets, all functions answer 0, and arrays may be null.
 *
 * Rounding decides whether a pair is in a list if its distance is the radius to within 8 units in the last
 * place of the radius (in a box: of the largest of radius, box length and coordinates). For such pairs the
 * result depends on the compiler, its flags and the path of the code. The same binary gives the same lists,
 * for any number of threads. Under -ffast-math a pair at exactly half of a periodic box may stand in a row
 * twice, once for each image.
 *
 * INDEX
 *   sph_index sph_search(dim, points, radius, criterion, memory, size, found)
 *                                                         neighbours, in one block of memory
 *   size_t    sph_search_size(dim, n, pairs)              bytes of that block, or 0
 *   sph_neighbors                                         what is found: number of pairs, list, grid
 *   size_t    sph_grid_workspace(dim, n)                  bytes of workspace for n sources, or 0
 *   sph_index sph_grid_build(dim, sources, radius, work, work_size, grid)
 *                                                         sorts the sources
 *   sph_query sph_query_of(points, criterion, radius, flags)
 *                                                         the neighbours of points among themselves
 *   sph_query sph_query_range(query, first, last)         of its targets those from first to last - 1
 *   sph_index sph_grid_count(dim, grid, query, start, pairs)
 *                                                         only the lengths of the lists
 *   sph_index sph_grid_lists(dim, grid, query, start, index, capacity, pairs)
 *                                                         the neighbour lists
 *   const sph_index *sph_grid_permutation(grid)           order[slot] = particle: into the grid's order
 *   sph_index sph_grid_renumber(grid)                     tells the grid that the arrays have been permuted
 *   sph_index sph_grid_permutation_own(grid, n, permutation)
 *                                                         the same for the first n particles alone,
 *   sph_index sph_grid_renumber_own(grid, n)              where the others stay behind them
 *   sph_index sph_permute(n, order, in, stride, out)      out[slot] = in[order[slot]], for each array
 *   sph_index sph_permute_inverse(n, order, inverse)      inverse[order[slot]] = slot
 *   sph_index sph_part_of(dim, points, radius, part)      several machines: where particles are, and how far
 *                                                         they reach
 *   sph_index sph_select_near(dim, points, radius, criterion, part, chosen, count)
 *                                                         which of them another machine needs
 *   sph_index sph_list_prune(n, n_total, start, index, kept, count)
 *                                                         without the sources that no row names
 *   sph_index sph_list_sort(n, n_total, start, index, key)
 *                                                         rows in the order of the host's keys
 *   int       sph_rebuild_due(dim, now, then, skin)       1 if a particle moved by more than skin / 2
 *   for lists that you make yourself, on a device too:
 *   sph_real  sph_grid_pair_radius(criterion, R_i, R_j)   below which a pair is a neighbour
 *   long      sph_grid_cell(x, low, inverse_width, cells)      the cell of a place along an axis,
 *   long      sph_grid_cell_periodic(x, low, inverse_width)    and where it may lie outside of a box
 *   long      sph_grid_image(cells, c)                    in which image a cell is
 *   sph_real  sph_grid_wrap(x, low, length)               x moved into a box
 *
 * OPTIONS, besides those of sph_kernels.h, and set in the same way
 *   SPH_OPENMP   0.
 *                1: the search uses the threads of OpenMP (compile with -fopenmp). The sweeps never start
 *                threads: call them on ranges, from your own threads.
 *   SPH_AVX512   1 where the compiler may use AVX-512 F and VL, else 0.
 *                1: the inner loop of the search is written by hand for AVX-512.
 *   SPH_AVX2     1 where the compiler may use AVX2, else 0.
 *                1: the same for AVX2. If both are 0, the loop is portable C.
 */
#include "sph_ops.h" /* each time, because the lowest header looks at the options each time */

#ifndef SPH_H
#define SPH_H

#if SPH_VERSION != 200
#error "sph.h and sph_ops.h are of different releases"
#endif

/* ================================================================ the arithmetic of a grid
 *
 * For those who make lists themselves: on a device (in OpenCL C this is all that there is of this header), or
 * with a grid of their own. Cells are counted along each axis, and in 64 bits.
 */

#if SPH_OPENCL
#define SPHI_INT64 long
#define SPHI_FLOOR(x) floor(x)
#else
#define SPHI_INT64 int64_t
#if SPH_SINGLE
#define SPHI_FLOOR(x) floorf(x)
#else
#define SPHI_FLOOR(x) floor(x)
#endif
#endif

SPHI_BEGIN

/* Which pairs at the distance r are neighbours; R_i and R_j are their support radii. The operators of
   sph_ops.h need a gather list. Pair-symmetric operators need the larger of both radii. */
typedef enum sph_criterion {
    SPH_GATHER,  /* r < R_i */
    SPH_SCATTER, /* r < R_j */
    SPH_LARGER,  /* r < max(R_i, R_j) */
    SPH_MEAN     /* r < (R_i + R_j) / 2 */
} sph_criterion;
/* The distance below which a pair with the support radii R_i and R_j is a neighbour, by a criterion (an
   sph_criterion). */
SPH_FN sph_real sph_grid_pair_radius(int criterion, sph_real R_i, sph_real R_j)
{
    switch (criterion) {
    case SPH_SCATTER:
        return R_j;
    case SPH_LARGER:
        return R_i > R_j ? R_i : R_j;
    case SPH_MEAN:
        return SPH_R(0.5) * (R_i + R_j);
    default:
        return R_i;
    }
}
/* The number of the cell of the place x along an axis, within [0, cells). The cells begin at low and have the
   width 1 / inverse_width; the first and the last take what lies beyond. It never falls as x rises, so all
   particles between x - radius and x + radius are in the cells between those of these two ends. */
SPH_FN SPHI_INT64 sph_grid_cell(sph_real x, sph_real low, sph_real inverse_width, SPHI_INT64 cells)
{
    const sph_real c = (x - low) * inverse_width, last = (sph_real)(cells - 1);
    return c > SPH_R(0) ? (c < last ? (SPHI_INT64)c : cells - 1) : 0;
}
/* The same along a periodic axis, for x at the ends of a search range, which may lie outside of the box:
   cells of the width 1 / inverse_width, the one that begins at low having the number 0. */
SPH_FN SPHI_INT64 sph_grid_cell_periodic(sph_real x, sph_real low, sph_real inverse_width)
{
    const sph_real c = (x - low) * inverse_width;
    const SPHI_INT64 i = (SPHI_INT64)c;
    return (sph_real)i > c ? i - 1 : i;
}
/* Moves x into [low, low + length). It does not change if it is there already. */
SPH_FN sph_real sph_grid_wrap(sph_real x, sph_real low, sph_real length)
{
    if (length > SPH_R(0) && !(x >= low && x < low + length)) {
        x -= length * SPHI_FLOOR((x - low) / length);
        if (!(x >= low && x < low + length)) x = low; /* rounding */
    }
    return x;
}
/* In which image the cell c of a periodic axis is, 0 being the box itself: inside the box it is the cell
   c - image cells, and a particle there is seen at its place plus image box lengths. Needs cells >= 1. */
SPH_FN SPHI_INT64 sph_grid_image(SPHI_INT64 cells, SPHI_INT64 c)
{
    SPH_ASSERT(cells >= 1);
    return c >= 0 ? c / cells : -((cells - 1 - c) / cells);
}

SPHI_END

#if !SPH_OPENCL

/* clang-format off */
#ifndef SPH_OPENMP
#  define SPH_OPENMP 0
#endif
#if !SPHI_IS_FLAG(SPH_OPENMP)
#  error "SPH_OPENMP must be 0 or 1"
#endif
#if SPH_OPENMP && !defined(_OPENMP)
#  error "SPH_OPENMP must be 0 here: the compiler was not told to use OpenMP (-fopenmp)"
#endif
#if defined(__AVX512F__) && defined(__AVX512VL__) && !defined(__CUDACC__)
#  define SPHI_HAS_AVX512 1
#else
#  define SPHI_HAS_AVX512 0
#endif
#ifndef SPH_AVX512
#  define SPH_AVX512 SPHI_HAS_AVX512
#endif
#if !SPHI_IS_FLAG(SPH_AVX512)
#  error "SPH_AVX512 must be 0 or 1"
#endif
#if SPH_AVX512 && !SPHI_HAS_AVX512
#  error "SPH_AVX512 must be 0 here: the compiler was not told to use AVX-512 F and VL (-march=native)"
#endif
#if defined(__AVX2__) && defined(__x86_64__) && !defined(__CUDACC__)
#  define SPHI_HAS_AVX2 1
#else
#  define SPHI_HAS_AVX2 0
#endif
#ifndef SPH_AVX2
#  define SPH_AVX2 SPHI_HAS_AVX2
#endif
#if !SPHI_IS_FLAG(SPH_AVX2)
#  error "SPH_AVX2 must be 0 or 1"
#endif
#if SPH_AVX2 && !SPHI_HAS_AVX2
#  error "SPH_AVX2 must be 0 here: the compiler was not told to use AVX2 on x86-64 (-march=native)"
#endif
#if SPH_OPENMP
#  include <omp.h>
#endif
#if SPH_AVX512 || SPH_AVX2
#  include <immintrin.h>
#endif
/* clang-format on */

SPHI_BEGIN

#define SPHI_INDEX_MAX ((((int64_t)1 << (8 * sizeof(sph_index) - 2)) - 1) * 2 + 1)

/* ================================================================ the grid */

typedef enum sph_list_flags {
    SPH_LIST_SELF = 1,   /* a row also holds its own particle */
    SPH_LIST_HALF = 2,   /* each pair once: only j > i (for a symmetric criterion) */
    SPH_LIST_SORTED = 4, /* each row in ascending order of j */
    SPH_LIST_FOREIGN = 8 /* target i has nothing to do with source i (not together with SELF or HALF) */
} sph_list_flags;

/* The sources, sorted into slots such that those of near slots are near each other, in one of three ways.
   CELLS: the grid's radius is the width of a cell in y and z, and that of SPHI_FINE cells in x. Cells that
   follow each other in x follow each other in memory, so that the neighbours of a particle are a few
   contiguous runs of slots. If the bounding box has no more than 2 n cells, each has its own bucket.
   HASHED CELLS: if it has more (most of them empty), cells are hashed into about n buckets; a row along x is
   still contiguous.
   A TREE, where radii differ so much that no width of a cell suits all of them: the slots are halved at the
   median of the longer axis, and so are the halves, down to leaves of at most SPHI_LEAF slots. Node 1 is the
   root, and the halves of node k are the nodes 2 k and 2 k + 1.
   The fields are for the functions below. */
typedef struct sph_grid {
    sph_index n;
    int dim, hashed, levels; /* levels: of the tree; 0 if there are cells */
    int scattered;           /* 1 if many particles that follow each other are not near each other */
    int64_t cells[3];        /* along each axis; around the box, if the axis is periodic */
    int64_t held[3];         /* of these the first ones, which may hold particles: the others are empty */
    size_t buckets;          /* a power of two if hashed */
    sph_real radius;         /* of all sources, or their mean */
    sph_real largest;        /* radius of a source */
    sph_vec low, inverse_width, box;
    sph_index *first, *member; /* first slot of each bucket; particle of each slot */
    sph_real *x, *y, *z;       /* coordinates of each slot, inside the box along periodic axes */
    sph_real *own;             /* radius of each slot, or null if all sources have the same */
    sph_real *node; /* of each node of a tree: centre and half lengths of its box, largest radius */
} sph_grid;

enum {
    SPHI_FINE = 8,      /* cells along x per radius */
    SPHI_PAD = 16,      /* slots beyond the last that whole lanes may read */
    SPHI_FARTHEST = 32, /* with a radius of more than so many cells a target looks at all slots */
    SPHI_ALIKE = 4,     /* radii that differ by no more than this factor take cells of one width */
    SPHI_VIEW = 64,     /* leaves that are kept for a group of targets; whole lanes */
    SPHI_IMAGES = 27,   /* of a periodic box and around it, */
    SPHI_INSIDE = 13,   /* and the number of the box itself */
    SPHI_ALIGN = 8,     /* bytes to which memory is aligned, inside the caller's */
    SPHI_CROWDS = 8,    /* crowded cells whose bounds are kept from one target to the next */
    SPHI_ROWS = 16      /* rows of a hashed grid whose places are kept, likewise */
};
/* tests take fewer */
#ifndef SPHI_CROWDED
#define SPHI_CROWDED 1024 /* a cell with as many particles is crowded */
#endif
#ifndef SPHI_LEAF
#define SPHI_LEAF 32 /* most slots in a leaf of the tree */
#endif

/* Bytes for the coordinates and the radius of a slot. The same memory first holds the bucket of each
   particle, until all have their slots: an index has at most 8 bytes, and these are at least 8. */
SPH_FN size_t sphi_place_size(int dim) { return ((size_t)dim + 1) * sizeof(sph_real); }
/* Bytes per slot for the first slots of the buckets, or for the tree, which has at most 4 nodes for SPHI_LEAF
   slots. */
SPH_FN size_t sphi_cells_size(int dim)
{
    const size_t nodes = (2 * (size_t)dim + 1) * sizeof(sph_real) * 4 / SPHI_LEAF;
    return nodes > 2 * sizeof(sph_index) ? nodes : 2 * sizeof(sph_index);
}
/* An even number of slots, so that an array of eight-byte numbers behind one of four-byte numbers
   is aligned. */
SPH_FN size_t sphi_padded(sph_index n) { return ((size_t)n + SPHI_PAD + 1) / 2 * 2; }
/* Bytes of workspace that sph_grid_build needs for n sources, with some to align it. It is 0 if dim is
   not 1, 2 or 3, or if n is negative or more than can be counted. It is not 0 for 0 sources, although
   they need no workspace. */
SPH_FN size_t sph_grid_workspace(int dim, sph_index n)
{
    const int d = dim > 0 && dim < 4 ? dim : 1;
    const size_t bytes = sphi_place_size(d) + sizeof(sph_index) + sphi_cells_size(d);
    if (dim != d || n < 0 || (uint64_t)n + SPHI_PAD + 1 > SIZE_MAX / bytes / 2) return 0;
    if (n > SPHI_INDEX_MAX - SPHI_TILE) return 0; /* loops over slots go by tiles, and look a tile ahead */
    return sphi_padded(n) * bytes + SPHI_ALIGN;
}
/* The first aligned byte of memory. */
SPH_FN void *sphi_aligned(void *memory)
{
    return (char *)memory + (SPHI_ALIGN - (uintptr_t)memory % SPHI_ALIGN) % SPHI_ALIGN;
}

SPH_FN sph_vec sphi_wrap_point(int dim, sph_vec p, sph_vec low, sph_vec box)
{
    p.x = sph_grid_wrap(p.x, low.x, box.x);
    if (dim > 1) p.y = sph_grid_wrap(p.y, low.y, box.y);
    if (dim > 2) p.z = sph_grid_wrap(p.z, low.z, box.z);
    return p;
}

SPH_FN sph_real sphi_lesser(sph_real a, sph_real b) { return a < b ? a : b; }
SPH_FN int sphi_boxed(int dim, sph_vec box)
{
    return box.x > SPH_R(0) || (dim > 1 && box.y > SPH_R(0)) || (dim > 2 && box.z > SPH_R(0));
}

/* The bucket of the first cell of a row along x. */
SPH_FN size_t sphi_row_bucket(const sph_grid *g, int64_t cy, int64_t cz)
{
    if (!g->hashed) return (size_t)((cz * g->held[1] + cy) * g->held[0]);
    {
        const uint64_t h =
            (uint64_t)cy * 0x9e3779b97f4a7c15u ^ ((uint64_t)cz + 0x7f4a7c15u) * 0xc2b2ae3d27d4eb4fu;
        return (size_t)((h ^ h >> 29) * 0xbf58476d1ce4e5b9u >> 20) & (g->buckets - 1);
    }
}
SPH_FN size_t sphi_bucket(int dim, const sph_grid *g, sph_vec p)
{
    const int64_t cy = dim > 1 ? sph_grid_cell(p.y, g->low.y, g->inverse_width.y, g->held[1]) : 0;
    const int64_t cz = dim > 2 ? sph_grid_cell(p.z, g->low.z, g->inverse_width.z, g->held[2]) : 0;
    const size_t b =
        sphi_row_bucket(g, cy, cz) + (size_t)sph_grid_cell(p.x, g->low.x, g->inverse_width.x, g->held[0]);
    return g->hashed ? b & (g->buckets - 1) : b;
}

/* A radius must be positive, and its square far from underflow and overflow. */
SPH_FN int sphi_radius_ok(sph_real radius)
{
    return sphi_finite(radius) && radius >= SPHI_TINY && radius <= SPH_R(1) / SPHI_TINY;
}
SPH_FN int sphi_check_points(int dim, sph_points x)
{
    int error;
    if (dim < 1 || dim > 3) return sphi_refuse("dim", -1, SPH_ERROR_DIM);
    if (x.n < 0) return sphi_refuse("points.n", -1, SPH_ERROR_COUNT);
    if (x.n == 0) return 0; /* nothing to point at */
    error = sphi_check_arrays(dim, x);
    return error ? error : sphi_check_positions(dim, x);
}
SPH_FN void sphi_enclose(sph_vec p, sph_vec *low, sph_vec *high)
{
    low->x = p.x < low->x ? p.x : low->x;
    low->y = p.y < low->y ? p.y : low->y;
    low->z = p.z < low->z ? p.z : low->z;
    high->x = p.x > high->x ? p.x : high->x;
    high->y = p.y > high->y ? p.y : high->y;
    high->z = p.z > high->z ? p.z : high->z;
}
/* Divides the axes into cells: sets low, inverse_width, cells and held. Along x there are `fine` cells per
   radius. Returns the number of all that may hold particles, which may be huge. */
SPH_FN double sphi_axes(int dim, sph_grid *g, sph_vec low, sph_vec high, sph_real radius, int fine)
{
    sph_real lows[3] = {low.x, low.y, low.z};
    const sph_real highs[3] = {high.x, high.y, high.z}, box[3] = {g->box.x, g->box.y, g->box.z};
    sph_real inverse[3] = {SPH_R(0), SPH_R(0), SPH_R(0)};
    double product = 1;
    int c;
    for (c = 0; c < 3; c++) {
        sph_real count;
        g->cells[c] = g->held[c] = 1;
        if (c >= dim) continue;
        inverse[c] = SPH_R(c == 0 ? fine : 1) / radius;
        if (box[c] > SPH_R(0)) {
            const int part = highs[c] - lows[c] < box[c];
            sph_real most;
            if (!part) lows[c] = SPH_R(0); /* some are moved, into [0, box) */
            /* a whole number of cells around the box, none of them so narrow that rounding matters (see
               sphi_range) */
            most = box[c] / (SPH_R(64) * SPH_EPSILON * (box[c] + SPHI_ABS(lows[c])));
            count = box[c] * inverse[c] < most ? box[c] * inverse[c] : most;
            g->cells[c] = count < SPH_R(1) ? 1 : (int64_t)count;
            inverse[c] = (sph_real)g->cells[c] / box[c];
            g->held[c] = g->cells[c];
            if (part) /* as far as the last particle, whatever the rounding */
                g->held[c] = sph_grid_cell(highs[c] + SPH_R(16) * SPH_EPSILON * (box[c] + SPHI_ABS(lows[c])),
                                           lows[c], inverse[c], g->cells[c]) +
                             1;
        } else {
            count = (highs[c] - lows[c]) * inverse[c];
            g->cells[c] = count < SPH_R(4e18)
                              ? (int64_t)count + 1
                              : (int64_t)4000000000000000000; /* beyond: the last cell is wide */
            g->held[c] = g->cells[c];
        }
        product *= (double)g->held[c];
    }
    g->low.x = lows[0];
    g->low.y = lows[1];
    g->low.z = lows[2];
    g->inverse_width.x = inverse[0];
    g->inverse_width.y = inverse[1];
    g->inverse_width.z = inverse[2];
    return product;
}

/* Where a part of n begins, if n is divided into so many parts. */
SPH_FN sph_index sphi_first(sph_index n, int part, int parts)
{
    return (sph_index)((int64_t)n * part / parts);
}
SPH_FN int sphi_parts(void)
{
#if SPH_OPENMP
    return omp_get_max_threads();
#else
    return 1;
#endif
}

/* Where a source is kept. There is only one compiled copy of this function. One loop finds the bucket of a
   particle, another stores its place. Both must get the same place to the last bit, and so the same side of
   the box, even where the compiler may round as it likes (-ffast-math). */
SPHI_LARGE sph_vec sphi_source(int dim, const sph_grid *g, sph_points s, sph_index i)
{
    return sphi_wrap_point(dim, sphi_point(dim, s, i), g->low, g->box);
}

/* The corners of the box around all sources. */
SPH_FN void sphi_bounds(int dim, sph_points s, sph_vec *low, sph_vec *high)
{
    const int parts = sphi_parts();
    int part;
    *low = *high = sphi_point(dim, s, 0);
#if SPH_OPENMP
#pragma omp parallel for
#endif
    for (part = 0; part < parts; part++) {
        const sph_index end = sphi_first(s.n, part + 1, parts);
        sph_index k = sphi_first(s.n, part, parts);
        sph_vec l = sphi_point(dim, s, k), h = l;
        for (; k < end; k++) {
            const sph_vec p = sphi_point(dim, s, k);
            sphi_enclose(p, &l, &h);
        }
#if SPH_OPENMP
#pragma omp critical(sphi_bounds)
#endif
        {
            sphi_enclose(l, low, high);
            sphi_enclose(h, low, high);
        }
    }
}

/* Finds where the particles are, if they fill a part of a periodic box and have been moved into it, so that
   they may lie at both of its ends: low ... high then begins behind the longest stretch without particles,
   and may end beyond the box. Returns 1 if that is shorter than it was along an axis, else 0. */
SPHI_LARGE int sphi_arcs(int dim, sph_points s, sph_vec *low, sph_vec *high)
{
    enum { BINS = 256 };
    const sph_real box[3] = {s.box.x, s.box.y, s.box.z};
    const SPH_GLOBAL sph_real *const axis[3] = {s.x, s.y, s.z};
    sph_real lows[3] = {low->x, low->y, low->z}, highs[3] = {high->x, high->y, high->z};
    int c, shorter = 0;
    for (c = 0; c < dim; c++) {
        unsigned char held[BINS] = {0};
        /* where a particle is moved to depends on low, by this rounding: none may pass low */
        const sph_real margin = SPH_R(16) * SPH_EPSILON * (box[c] + SPHI_ABS(lows[c]) + SPHI_ABS(highs[c]));
        sph_real edge, first, last;
        int b, empty = 0, longest = 0, end = 0;
        sph_index i;
        if (!(box[c] > SPH_R(0))) continue;
        for (i = 0; i < s.n; i++) {
            const sph_real x = sph_grid_wrap(axis[c][(size_t)i * s.stride], SPH_R(0), box[c]);
            held[sph_grid_cell(x, SPH_R(0), SPH_R(BINS) / box[c], BINS)] = 1;
        }
        for (b = 0; b < 2 * BINS; b++) { /* twice around */
            empty = held[b % BINS] ? 0 : empty + 1;
            if (empty > longest) {
                longest = empty;
                end = b + 1;
            }
        }
        if (longest < 2) continue;
        edge = (sph_real)(end % BINS) * (box[c] / SPH_R(BINS));
        first = edge + box[c];
        last = edge;
        for (i = 0; i < s.n; i++) {
            const sph_real x = sph_grid_wrap(axis[c][(size_t)i * s.stride], edge, box[c]);
            if (x < first) first = x;
            if (x > last) last = x;
        }
        if (!(last - first + SPH_R(4) * margin < sphi_lesser(box[c], highs[c] - lows[c]))) continue;
        lows[c] = first - margin;
        highs[c] = last + margin;
        shorter = 1;
    }
    low->x = lows[0];
    low->y = lows[1];
    low->z = lows[2];
    high->x = highs[0];
    high->y = highs[1];
    high->z = highs[2];
    return shorter;
}
/* Divides the axes so that there are no more than `most` cells, with as many per radius along x as there can
   be. Returns that number, or 0 if there are too many cells even with one. */
SPH_FN int sphi_fineness(int dim, sph_grid *g, sph_vec low, sph_vec high, double most)
{
    int fine = SPHI_FINE;
    while (fine > 0 && sphi_axes(dim, g, low, high, g->radius, fine) > most) fine /= 2;
    return fine;
}

/* Three loops over the particles find buckets, slots and coordinates. Only the second one cannot run in
   parallel. If the particles are stored in an order far from that of the cells, each loop then waits for one
   kind of distant memory only, and for many such accesses at a time. */
SPHI_LARGE void sphi_cells_fill(int dim, sph_points s, sph_scalars radius, sph_grid *g)
{
    const double most =
        2.0 * (double)s.n < (double)SPHI_INDEX_MAX ? 2.0 * (double)s.n : (double)SPHI_INDEX_MAX;
    const int parts = sphi_parts(), boxed = sphi_boxed(dim, g->box);
    sph_index *const bucket_of = (sph_index *)(void *)g->x;
    sph_vec low, high;
    sph_index i, jumps = 0, last = 0;
    size_t b;
    int fine, part;
    sphi_bounds(dim, s, &low, &high);
    fine = sphi_fineness(dim, g, low, high, most);
    if (fine < SPHI_FINE && boxed && sphi_arcs(dim, s, &low, &high))
        fine = sphi_fineness(dim, g, low, high, most);
    g->hashed = fine == 0;
    if (g->hashed)
        for (g->buckets = 1; g->buckets <= (size_t)s.n; g->buckets *= 2) {}
    else g->buckets = (size_t)(g->held[0] * g->held[1] * g->held[2]);

#if SPH_OPENMP
#pragma omp parallel for
#endif
    for (part = 0; part < parts; part++) {
        const sph_index end = sphi_first(s.n, part + 1, parts);
        sph_index k;
        for (k = sphi_first(s.n, part, parts); k < end; k++) {
            const sph_vec p = boxed ? sphi_source(dim, g, s, k) : sphi_point(dim, s, k);
            bucket_of[k] = (sph_index)sphi_bucket(dim, g, p);
        }
    }
    /* A counting sort. first[b + 2] counts bucket b. Then first[b + 1] is its next free slot, and in the end
       the first slot of bucket b + 1. */
    for (b = 0; b < g->buckets + 2; b++) g->first[b] = 0;
    for (i = 0; i < s.n; i++) {
        const sph_index bucket = bucket_of[i];
        jumps += bucket - last > 2 * SPHI_FINE || last - bucket > 2 * SPHI_FINE;
        last = bucket;
        g->first[(size_t)bucket + 2]++;
    }
    g->scattered = jumps > s.n / 4;
    for (b = 2; b < g->buckets + 2; b++) g->first[b] += g->first[b - 1];
    for (i = 0; i < s.n; i++) g->member[g->first[(size_t)bucket_of[i] + 1]++] = i;
#if SPH_OPENMP
#pragma omp parallel for
#endif
    for (part = 0; part < parts; part++) {
        const sph_index end = sphi_first(s.n, part + 1, parts);
        sph_index k;
        for (k = sphi_first(s.n, part, parts); k < end; k++) {
            const sph_index j = g->member[k];
            const sph_vec p = boxed ? sphi_source(dim, g, s, j) : sphi_point(dim, s, j);
            g->x[k] = p.x;
            if (dim > 1) g->y[k] = p.y;
            if (dim > 2) g->z[k] = p.z;
            if (g->own) g->own[k] = sphi_at(radius, j);
        }
    }
}

/* -------- the tree */

/* The first slot of the i-th node of a level. Node 2^level + i has the slots from there to the next one. */
SPH_FN sph_index sphi_cut(sph_index n, int level, int64_t i)
{
    const int64_t each = (int64_t)n >> level, rest = (int64_t)n - (each << level);
    return (sph_index)(each * i + (rest * i >> level));
}
SPH_FN sph_real *sphi_node(const sph_grid *g, int64_t k) { return g->node + (2 * g->dim + 1) * k; }

SPH_FN void sphi_swap(const sph_grid *g, sph_real *const *arrays, int count, sph_index a, sph_index b)
{
    const sph_index j = g->member[a];
    int c;
    for (c = 0; c < count; c++) {
        const sph_real v = arrays[c][a];
        arrays[c][a] = arrays[c][b];
        arrays[c][b] = v;
    }
    g->member[a] = g->member[b];
    g->member[b] = j;
}
/* Moves the slots first ... end - 1 until none of those before `middle` has a larger key than one of the
   others (C. A. R. Hoare, 1961, Comm. ACM 4, 321: algorithms 63 and 65). keys is one of the arrays. The pivot
   has about the rank that is looked for within some keys. They are taken at random places, because regular
   ones may all be on one side of a lattice; these depend on the arguments alone. */
SPHI_LARGE void sphi_select(const sph_grid *g, const sph_real *keys, sph_real *const *arrays, int count,
                            sph_index first, sph_index end, sph_index middle)
{
    uint32_t random = (uint32_t)first * 2654435761u + (uint32_t)end;
    while (end - first > 1) {
        const sph_index n = end - first;
        const int samples = n > 4096 ? 31 : n > 512 ? 15 : n > 64 ? 7 : 3;
        sph_real sample[31], pivot;
        sph_index a = first, b = end - 1;
        int s, t;
        for (s = 0; s < samples; s++) {
            sph_real v;
            random = random * 1664525u + 1013904223u;
            v = keys[first + (sph_index)((double)n * random / 4294967296.0)];
            for (t = s; t > 0 && sample[t - 1] > v; t--) sample[t] = sample[t - 1];
            sample[t] = v;
        }
        pivot = sample[(int)((double)(middle - first) * samples / (double)n)];
        for (;;) {
            while (keys[a] < pivot) a++;
            while (keys[b] > pivot) b--;
            if (a >= b) break;
            sphi_swap(g, arrays, count, a++, b--);
        }
        /* slots before a are not above the pivot, slots behind b not below it; a may be b, in its place */
        if (middle == a) return;
        if (middle < a) end = a;
        else first = b + 1;
    }
}
/* Finds the box of a node and halves its slots, if it is no leaf. */
SPHI_LARGE void sphi_node_make(const sph_grid *g, sph_real *const *arrays, int count, int level, int64_t i)
{
    const sph_index first = sphi_cut(g->n, level, i), end = sphi_cut(g->n, level, i + 1);
    const int dim = g->dim;
    sph_real *const node = sphi_node(g, ((int64_t)1 << level) + i);
    int c, longest = 0;
    for (c = 0; c < count; c++) {
        const sph_real *const v = arrays[c];
        sph_real low = v[first], high = low;
        sph_index k;
        for (k = first + 1; k < end; k++) {
            low = v[k] < low ? v[k] : low;
            high = v[k] > high ? v[k] : high;
        }
        if (c == dim) node[2 * dim] = high;
        else {
            node[c] = SPH_R(0.5) * low + SPH_R(0.5) * high;
            node[dim + c] = high - node[c] > node[c] - low ? high - node[c] : node[c] - low;
            if (node[dim + c] > node[dim + longest]) longest = c;
        }
    }
    if (level + 1 < g->levels)
        sphi_select(g, arrays[longest], arrays, count, first, end, sphi_cut(g->n, level + 1, 2 * i + 1));
}
/* The sources in the order of a tree, with its nodes. */
SPHI_LARGE void sphi_tree_fill(int dim, sph_points s, sph_scalars radius, sph_grid *g)
{
    sph_real *const arrays[4] = {g->x, dim > 1 ? g->y : g->own, dim > 2 ? g->z : g->own, g->own};
    const int parts = sphi_parts();
    sph_vec low, high;
    sph_index jumps = 0;
    int top, part;
    int64_t i;
    sphi_bounds(dim, s, &low, &high);
    sphi_axes(dim, g, low, high, g->largest, 1); /* sets low, for periodic axes */
#if SPH_OPENMP
#pragma omp parallel for reduction(+ : jumps)
#endif
    for (part = 0; part < parts; part++) {
        const sph_index end = sphi_first(s.n, part + 1, parts);
        sph_index k = sphi_first(s.n, part, parts);
        sph_vec last = sphi_source(dim, g, s, k);
        for (; k < end; k++) {
            const sph_vec p = sphi_source(dim, g, s, k);
            const sph_real reach = SPH_R(2) * sphi_at(radius, k);
            jumps += SPHI_ABS(p.x - last.x) > reach || (dim > 1 && SPHI_ABS(p.y - last.y) > reach) ||
                     (dim > 2 && SPHI_ABS(p.z - last.z) > reach);
            last = p;
            g->member[k] = k;
            g->x[k] = p.x;
            if (dim > 1) g->y[k] = p.y;
            if (dim > 2) g->z[k] = p.z;
            g->own[k] = sphi_at(radius, k);
        }
    }
    g->scattered = jumps > s.n / 4;
    for (g->levels = 1; (int64_t)SPHI_LEAF << (g->levels - 1) < s.n; g->levels++) {}
    /* level by level as long as nodes are large, then one branch after the other, which stays in the cache */
    for (top = 0; top < g->levels - 1 && s.n >> top > 4096; top++) {
        const int64_t nodes = (int64_t)1 << top;
#if SPH_OPENMP
#pragma omp parallel for schedule(dynamic, 1)
#endif
        for (i = 0; i < nodes; i++) sphi_node_make(g, arrays, dim + 1, top, i);
    }
#if SPH_OPENMP
#pragma omp parallel for schedule(dynamic, 1)
#endif
    for (i = 0; i < (int64_t)1 << top; i++) {
        int level;
        for (level = top; level < g->levels; level++) {
            int64_t k;
            for (k = i << (level - top); k < (i + 1) << (level - top); k++)
                sphi_node_make(g, arrays, dim + 1, level, k);
        }
    }
}

/* A grid of no sources. */
SPH_FN void sphi_grid_empty(int dim, sph_grid *grid)
{
    grid->n = 0;
    grid->dim = dim;
    grid->hashed = grid->levels = grid->scattered = 0;
    grid->cells[0] = grid->cells[1] = grid->cells[2] = 0;
    grid->held[0] = grid->held[1] = grid->held[2] = 0;
    grid->buckets = 0;
    grid->radius = grid->largest = SPH_R(0);
    grid->low.x = grid->low.y = grid->low.z = SPH_R(0);
    grid->inverse_width = grid->box = grid->low;
    grid->first = grid->member = 0;
    grid->x = grid->y = grid->z = grid->own = grid->node = 0;
}

/* Sets the mean and the largest of the radii. *alike becomes 1 if no two of them differ by more than the
   factor SPHI_ALIKE. Returns 0 or a negative sph_error. */
SPH_FN int sphi_radii(sph_index n, sph_scalars radius, sph_real *mean, sph_real *largest, int *alike)
{
    const sph_index count = radius.stride ? n : 1;
    sph_real least;
    double sum = 0;
    sph_index i;
    *mean = *largest = SPH_R(0); /* gcc -Og does not see that nobody reads them after an error */
    *alike = 0;
    if (!radius.p) return sphi_refuse("radius", -1, SPH_ERROR_NULL);
    least = *largest = sphi_at(radius, 0);
    for (i = 0; i < count; i++) {
        const sph_real own = sphi_at(radius, i);
        if (!sphi_radius_ok(own)) return sphi_refuse("radius", i, SPH_ERROR_H);
        *largest = own > *largest ? own : *largest;
        least = own < least ? own : least;
        sum += (double)own / (double)count;
    }
    *mean = least < *largest ? (sph_real)sum : least;
    *alike = !(*largest > SPH_R(SPHI_ALIKE) * least);
    return 0;
}

/* Makes the grid of sources, radii and workspace that have been checked. */
SPH_FN void sphi_grid_make(int dim, sph_points sources, sph_scalars radius, sph_real mean, sph_real largest,
                           int alike, void *work, sph_grid *grid)
{
    const size_t padded = sphi_padded(sources.n);
    sph_index k;
    work = sphi_aligned(work);
    sphi_grid_empty(dim, grid);
    grid->n = sources.n;
    grid->box = sources.box;
    grid->radius = mean;
    grid->largest = largest;
    grid->x = (sph_real *)work;
    grid->y = grid->x + (dim > 1 ? padded : 0);
    grid->z = grid->y + (dim > 2 ? padded : 0);
    if (radius.stride) grid->own = grid->z + padded;
    grid->node = (sph_real *)(void *)((char *)work + padded * sphi_place_size(dim));
    grid->first = (sph_index *)(void *)grid->node;
    grid->member = (sph_index *)(void *)((char *)grid->node + padded * sphi_cells_size(dim));
    if (alike) {
        if (dim == 1) sphi_cells_fill(1, sources, radius, grid);
        else if (dim == 2) sphi_cells_fill(2, sources, radius, grid);
        else sphi_cells_fill(3, sources, radius, grid);
    } else sphi_tree_fill(dim, sources, radius, grid);
    for (k = sources.n; k < sources.n + SPHI_PAD; k++) { /* whole lanes read these slots, nothing uses them */
        grid->member[k] = 0;
        grid->x[k] = SPH_R(0);
        if (dim > 1) grid->y[k] = SPH_R(0);
        if (dim > 2) grid->z[k] = SPH_R(0);
        if (grid->own) grid->own[k] = SPH_R(0);
    }
}

/* Sorts the sources. radius: the support radius of each source, or one for all (sph_scalars_same). Give those
   that you will mostly search with: other radii find the same neighbours, but far larger or smaller ones take
   longer. None may be more than half of a box length. Coordinates and radii are copied, so later changes of
   the arrays do not matter until the next build. work may be aligned in any way. Without sources the grid is
   empty; work and radius are then not read, and may be null.
   Returns 0 or a negative sph_error: SPH_ERROR_CAPACITY if work_size is below
   sph_grid_workspace(dim, sources.n); SPH_ERROR_H and SPH_ERROR_BOX as for sph_grid_lists. */
SPH_FN sph_index sph_grid_build(int dim, sph_points sources, sph_scalars radius, void *work, size_t work_size,
                                sph_grid *grid)
{
    sph_real mean, largest;
    int alike, error = sphi_check_points(dim, sources);
    if (error) return error;
    if (!grid || (!work && sources.n > 0)) return sphi_refuse("work, grid", -1, SPH_ERROR_NULL);
    if (sources.n == 0) {
        sphi_grid_empty(dim, grid);
        return 0;
    }
    if (sph_grid_workspace(dim, sources.n) == 0) return sphi_refuse("sources.n", -1, SPH_ERROR_COUNT);
    error = sphi_radii(sources.n, radius, &mean, &largest, &alike);
    if (error) return error;
    if (sphi_check_box(dim, sources, largest, 0)) return SPH_ERROR_BOX;
    if (work_size < sph_grid_workspace(dim, sources.n)) return SPH_ERROR_CAPACITY;
    sphi_grid_make(dim, sources, radius, mean, largest, alike, work, grid);
    return 0;
}

/* The permutation into the grid's order: order[slot] = particle. It is null if grid is null, or empty. */
SPH_FN const sph_index *sph_grid_permutation(const sph_grid *grid) { return grid ? grid->member : 0; }

/* The permutation for a host whose first n particles are its own, and whose other ones are copies of those of
   other machines, which stay behind: permutation[0 ... grid->n - 1] puts the own ones into the grid's order,
   and leaves the others where they are. For sph_permute, and then for sph_grid_renumber_own. Returns 0 or a
   negative sph_error. */
SPH_FN sph_index sph_grid_permutation_own(const sph_grid *grid, sph_index n, sph_index *permutation)
{
    sph_index s, next = 0;
    if (!grid) return sphi_refuse("grid", -1, SPH_ERROR_NULL);
    if (n < 0 || n > grid->n) return sphi_refuse("n", -1, SPH_ERROR_COUNT);
    if (grid->n == 0) return 0;
    if (!permutation) return sphi_refuse("permutation", -1, SPH_ERROR_NULL);
    for (s = 0; s < grid->n; s++)
        if (grid->member[s] < n) permutation[next++] = grid->member[s];
    for (s = n; s < grid->n; s++) permutation[s] = s;
    return 0;
}
/* For a host that has put its first n particles into the grid's order, and has left the others. The grid then
   uses the new numbers. Returns 0 or a negative sph_error. */
SPH_FN sph_index sph_grid_renumber_own(sph_grid *grid, sph_index n)
{
    sph_index s, next = 0;
    if (!grid) return sphi_refuse("grid", -1, SPH_ERROR_NULL);
    if (n < 0 || n > grid->n) return sphi_refuse("n", -1, SPH_ERROR_COUNT);
    for (s = 0; s < grid->n; s++)
        if (grid->member[s] < n) grid->member[s] = next++;
    grid->scattered = 0;
    return 0;
}
/* The same for a host that has put all its arrays into this order (sph_permute with sph_grid_permutation).
   The grid is then as if it had been built from the new arrays, and sph_grid_permutation is the identity.
   The old order is lost, so permute first. Returns 0, or SPH_ERROR_NULL. */
SPH_FN sph_index sph_grid_renumber(sph_grid *grid)
{
    return grid ? sph_grid_renumber_own(grid, grid->n) : sphi_refuse("grid", -1, SPH_ERROR_NULL);
}

/* ================================================================ lists */

/* A crowded cell: its particles lie between the corners low and high, and none of their radii is
   below `least`. */
typedef struct sphi_crowd {
    size_t bucket;
    sph_vec low, high;
    sph_real least;
} sphi_crowd;
typedef struct sphi_crowds {
    sphi_crowd of[SPHI_CROWDS];
    int count, next; /* how many are known, and which one is replaced next */
} sphi_crowds;

/* Where the rows y0 ... y1, z0 ... z1 of a hashed grid begin in the table, kept from one target to the next.
   Stretches of up to `apart` buckets from there on do not overlap. */
typedef struct sphi_rows {
    int64_t y0, y1, z0, z1;
    size_t apart, from[SPHI_ROWS];
} sphi_rows;

/* The leaves of a tree that a group of targets may see, which follow each other and are near each other, in
   the images in which they are seen. */
typedef struct sphi_view {
    sph_index until;        /* the group ends before this target */
    sph_vec p, half_length; /* the middle of the targets, and how far they are from it along each axis */
    sph_real own;           /* their largest radius */
    sph_real slack;         /* by how much rounding may change a distance */
    int image;              /* from where to look for more, if there was no room for all: image and node; */
    int64_t next;           /* or SPHI_IMAGES and 0 */
    int count;
    signed char seen_in[SPHI_VIEW];
    sph_index leaf[SPHI_VIEW];
    sph_real x[SPHI_VIEW], y[SPHI_VIEW], z[SPHI_VIEW];    /* the middle of each leaf */
    sph_real dx[SPHI_VIEW], dy[SPHI_VIEW], dz[SPHI_VIEW]; /* half of its lengths and the slack */
    sph_real largest[SPHI_VIEW];                          /* of its radii */
} sphi_view;

/* What the search for one list needs. */
typedef struct sphi_search {
    sph_vec p;             /* the target, inside the box */
    sph_real radius;       /* nothing farther is a neighbour */
    sph_real own;          /* R_i */
    sph_real widest;       /* half of the smallest box: within a larger radius a pair may have two images */
    int criterion;         /* how the radius of a pair follows from own and that of the source */
    sph_index skip, least; /* without the particle skip, and only particles from least on */
    sphi_crowds *crowds;
    sphi_rows *rows;
    sphi_view *view;
} sphi_search;

/* The cells x0 ... x1 of a row along x, and the image in which they are seen: `shift` is 0, or
   whole box lengths. */
typedef struct sphi_run {
    int64_t x0, x1, y, z;
    sph_vec shift;
    int own; /* 0: the particle that is to be left out is not expected here, and not looked for */
    int met; /* becomes 1 where it was found, or would have been */
} sphi_run;

/* The place of a slot, inside the box. */
SPH_FN sph_vec sphi_slot(int dim, const sph_grid *g, sph_index slot)
{
    sph_vec p;
    p.x = g->x[slot];
    p.y = dim > 1 ? g->y[slot] : SPH_R(0);
    p.z = dim > 2 ? g->z[slot] : SPH_R(0);
    return p;
}
/* Whether a place belongs to a run. The buckets of a hashed grid also hold particles of other cells, and each
   must count in its own row only. */
SPH_FN int sphi_in_run(int dim, const sph_grid *g, sph_vec p, const sphi_run *run)
{
    const int64_t x = sph_grid_cell(p.x, g->low.x, g->inverse_width.x, g->held[0]);
    if (x < run->x0 || x > run->x1) return 0;
    if (dim > 1 && sph_grid_cell(p.y, g->low.y, g->inverse_width.y, g->held[1]) != run->y) return 0;
    return dim < 3 || sph_grid_cell(p.z, g->low.z, g->inverse_width.z, g->held[2]) == run->z;
}

/* What is known when the loops are compiled: that there is a tree, or that cells are hashed, with any radii;
   or that they are not hashed, with radii of pairs, with one radius in some box, or with one radius in an
   open domain. */
enum { SPHI_TREE, SPHI_HASHED, SPHI_RADII, SPHI_BOXED, SPHI_OPEN };

/* The squares of the radii of pairs with n sources, which have these radii. */
SPH_FN void sphi_limits_by(int criterion, const sphi_search *s, const sph_real *radius, int n,
                           sph_real *limit)
{
    const sph_real own = s->own, widest = s->widest;
    int l;
    SPH_ASSERT(n >= SPHI_BLOCK);
    for (l = 0; l < n; l++) {
        const sph_real pair = sphi_lesser(sph_grid_pair_radius(criterion, own, radius[l]), widest);
        limit[l] = pair * pair;
    }
}
SPH_FN void sphi_limits(const sphi_search *s, const sph_real *radius, int n, sph_real *limit)
{
    int l;
    SPH_ASSERT(n >= SPHI_BLOCK); /* whole lanes */
    if (s->criterion == SPH_SCATTER) sphi_limits_by(SPH_SCATTER, s, radius, n, limit);
    else if (s->criterion == SPH_LARGER) sphi_limits_by(SPH_LARGER, s, radius, n, limit);
    else if (s->criterion == SPH_MEAN) sphi_limits_by(SPH_MEAN, s, radius, n, limit);
    else
        for (l = 0; l < n; l++) limit[l] = s->radius * s->radius;
}

/* 1 for numbers below 0, by the sign bit. Reading this bit costs less than a comparison. */
SPH_FN unsigned sphi_negative(sph_real x)
{
#if SPH_SINGLE
    union {
        float f;
        uint32_t u;
    } v;
    v.f = x;
    return (unsigned)(v.u >> 31);
#else
    union {
        double f;
        uint64_t u;
    } v;
    v.f = x;
    return (unsigned)(v.u >> 63);
#endif
}

/* Of the slots a ... b - 1, stores the neighbours at out[count] and behind it, as long as count < room. It
   counts all of them, and returns the new count. */
SPH_FN int64_t sphi_filter_portable(int dim, int kind, const sph_grid *g, const sphi_search *s, sphi_run *run,
                                    sph_index a, sph_index b, sph_index *out, int64_t room, int64_t count)
{
    const sph_vec p = s->p, shift = run->shift;
    const sph_real limit = s->radius * s->radius;
    const sph_index skip = s->skip, least = s->least;
    const int store = kind != SPHI_HASHED && count + (int64_t)(b - a) + 4 <= room,
              tally = kind != SPHI_HASHED && room <= 0; /* every list of a pass is counted so, or none */
    int met = tally;
    for (; a < b; a += SPHI_TILE) {
        const int n = b - a < SPHI_TILE ? (int)(b - a) : (int)SPHI_TILE;
        const sph_index *const member = g->member + a;
        /* excess: the square of the distance minus that of the radius; it is negative for neighbours */
        sph_real limits[SPHI_TILE], excess[SPHI_TILE];
        int c, l;
        if (kind <= SPHI_RADII)
            sphi_limits(s, g->own ? g->own + a : 0, (n + SPHI_BLOCK - 1) / SPHI_BLOCK * SPHI_BLOCK, limits);
        for (c = 0; c < n; c += SPHI_BLOCK)
            for (l = c; l < c + SPHI_BLOCK; l++) {
                const sph_real dx = (p.x - g->x[a + l]) - shift.x;
                const sph_real dy = dim > 1 ? (p.y - g->y[a + l]) - shift.y : SPH_R(0);
                const sph_real dz = dim > 2 ? (p.z - g->z[a + l]) - shift.z : SPH_R(0);
                const sph_real d2 = dx * dx + (dim > 1 ? dy * dy : SPH_R(0)) + (dim > 2 ? dz * dz : SPH_R(0));
                excess[l] = d2 - (kind <= SPHI_RADII ? limits[l] : limit);
            }
        if (store) {
            /* without a branch: every candidate is stored, and overwritten by the next if it is not near */
            sph_index *next = out + count;
            if (least == 0 && !run->own) { /* four at a time, of which those beyond the end are not near */
#define SPHI_KEEP(l) \
    *next = member[l]; \
    next += sphi_negative(excess[l]);
                for (l = n; l % 4 != 0; l++) excess[l] = SPH_R(0);
                for (l = 0; l < n; l += 4) {
                    SPHI_KEEP(l)
                    SPHI_KEEP(l + 1)
                    SPHI_KEEP(l + 2)
                    SPHI_KEEP(l + 3)
                }
#undef SPHI_KEEP
            } else
                for (l = 0; l < n; l++) {
                    *next = member[l];
                    next += sphi_negative(excess[l]) & (member[l] != skip) & (member[l] >= least);
                    met |= member[l] == skip;
                }
            count = next - out;
        } else if (tally) {
            unsigned found = 0;
            for (l = 0; l < n; l++)
                found += sphi_negative(excess[l]) & (member[l] != skip) & (member[l] >= least);
            count += found;
        } else
            for (l = 0; l < n; l++) {
                const sph_index j = member[l];
                met |= j == skip;
                if (!sphi_negative(excess[l]) || j == skip || j < least ||
                    (kind == SPHI_HASHED && !sphi_in_run(dim, g, sphi_slot(dim, g, a + l), run)))
                    continue;
                if (count < room) out[count] = j;
                count++;
            }
    }
    run->met |= met;
    return count;
}

#if SPH_AVX512 || SPH_AVX2
#define SPHI_WIDE_PATH (sizeof(sph_index) == 4)
#if !SPH_AVX512
/* For each mask of eight bits the numbers of its bits, as bytes. h and l are those of the upper and the lower
   half, of which the lower one has n. (pdep and pext would do without a table, but take some hundred cycles
   on processors before Zen 3.) */
#define SPHI_BITS(h, l, n) (l | (h | (uint64_t)0x04040404) << 8 * n)
#define SPHI_HALVES(each, h) \
    each(h, 0, 0), each(h, 0, 1), each(h, 1, 1), each(h, 0x100, 2), each(h, 2, 1), each(h, 0x200, 2), \
        each(h, 0x201, 2), each(h, 0x20100, 3), each(h, 3, 1), each(h, 0x300, 2), each(h, 0x301, 2), \
        each(h, 0x30100, 3), each(h, 0x302, 2), each(h, 0x30200, 3), each(h, 0x30201, 3), \
        each(h, 0x3020100, 4)
static const uint64_t sphi_bits[256] = {
    SPHI_HALVES(SPHI_BITS, 0),        SPHI_HALVES(SPHI_BITS, 0),       SPHI_HALVES(SPHI_BITS, 1),
    SPHI_HALVES(SPHI_BITS, 0x100),    SPHI_HALVES(SPHI_BITS, 2),       SPHI_HALVES(SPHI_BITS, 0x200),
    SPHI_HALVES(SPHI_BITS, 0x201),    SPHI_HALVES(SPHI_BITS, 0x20100), SPHI_HALVES(SPHI_BITS, 3),
    SPHI_HALVES(SPHI_BITS, 0x300),    SPHI_HALVES(SPHI_BITS, 0x301),   SPHI_HALVES(SPHI_BITS, 0x30100),
    SPHI_HALVES(SPHI_BITS, 0x302),    SPHI_HALVES(SPHI_BITS, 0x30200), SPHI_HALVES(SPHI_BITS, 0x30201),
    SPHI_HALVES(SPHI_BITS, 0x3020100)};
#undef SPHI_HALVES
#undef SPHI_BITS
#endif
/* Packs those of the eight indices that the mask names. It writes eight entries. */
SPH_FN void sphi_compress8(sph_index *out, __m256i j, unsigned mask)
{
#if SPH_AVX512
    _mm256_storeu_si256((__m256i *)(void *)out, _mm256_maskz_compress_epi32((__mmask8)mask, j));
#else
    const __m256i order = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)sphi_bits[mask]));
    _mm256_storeu_si256((__m256i *)(void *)out, _mm256_permutevar8x32_epi32(j, order));
#endif
}

/* A mask of those of the eight slots from m on that are nearer than the limit, or than the eight limits if
   there are any. The limits are squares of distances. */
#if SPH_SINGLE
SPH_FN __m256 sphi_square8(float p, const float *x, float shift)
{
    const __m256 d =
        _mm256_sub_ps(_mm256_sub_ps(_mm256_set1_ps(p), _mm256_loadu_ps(x)), _mm256_set1_ps(shift));
    return _mm256_mul_ps(d, d);
}
SPH_FN unsigned sphi_nearer8(int dim, const sph_grid *g, const sphi_search *s, sph_index m, sph_vec shift,
                             float limit, const float *limits)
{
    __m256 d2 = sphi_square8(s->p.x, g->x + m, shift.x);
    if (dim > 1) d2 = _mm256_add_ps(d2, sphi_square8(s->p.y, g->y + m, shift.y));
    if (dim > 2) d2 = _mm256_add_ps(d2, sphi_square8(s->p.z, g->z + m, shift.z));
    return (unsigned)_mm256_movemask_ps(
        _mm256_cmp_ps(d2, limits ? _mm256_loadu_ps(limits) : _mm256_set1_ps(limit), _CMP_LT_OQ));
}
#elif SPH_AVX512
SPH_FN __m512d sphi_square8(double p, const double *x, double shift)
{
    const __m512d d =
        _mm512_sub_pd(_mm512_sub_pd(_mm512_set1_pd(p), _mm512_loadu_pd(x)), _mm512_set1_pd(shift));
    return _mm512_mul_pd(d, d);
}
SPH_FN unsigned sphi_nearer8(int dim, const sph_grid *g, const sphi_search *s, sph_index m, sph_vec shift,
                             double limit, const double *limits)
{
    __m512d d2 = sphi_square8(s->p.x, g->x + m, shift.x);
    if (dim > 1) d2 = _mm512_add_pd(d2, sphi_square8(s->p.y, g->y + m, shift.y));
    if (dim > 2) d2 = _mm512_add_pd(d2, sphi_square8(s->p.z, g->z + m, shift.z));
    return _mm512_cmp_pd_mask(d2, limits ? _mm512_loadu_pd(limits) : _mm512_set1_pd(limit), _CMP_LT_OQ);
}
#else
SPH_FN __m256d sphi_square4(double p, const double *x, double shift)
{
    const __m256d d =
        _mm256_sub_pd(_mm256_sub_pd(_mm256_set1_pd(p), _mm256_loadu_pd(x)), _mm256_set1_pd(shift));
    return _mm256_mul_pd(d, d);
}
SPH_FN unsigned sphi_nearer4(int dim, const sph_grid *g, const sphi_search *s, sph_index m, sph_vec shift,
                             double limit, const double *limits)
{
    __m256d d2 = sphi_square4(s->p.x, g->x + m, shift.x);
    if (dim > 1) d2 = _mm256_add_pd(d2, sphi_square4(s->p.y, g->y + m, shift.y));
    if (dim > 2) d2 = _mm256_add_pd(d2, sphi_square4(s->p.z, g->z + m, shift.z));
    return (unsigned)_mm256_movemask_pd(
        _mm256_cmp_pd(d2, limits ? _mm256_loadu_pd(limits) : _mm256_set1_pd(limit), _CMP_LT_OQ));
}
SPH_FN unsigned sphi_nearer8(int dim, const sph_grid *g, const sphi_search *s, sph_index m, sph_vec shift,
                             double limit, const double *limits)
{
    return sphi_nearer4(dim, g, s, m, shift, limit, limits) |
           sphi_nearer4(dim, g, s, m + 4, shift, limit, limits ? limits + 4 : 0) << 4;
}
#endif

/* With store = 0 it only counts, and out is not touched. */
SPH_FN int64_t sphi_filter_wide(int dim, int kind, const sph_grid *g, const sphi_search *s, sph_vec shift,
                                sph_index a, sph_index b, sph_index *out, int store, int64_t count)
{
    const sph_real limit = s->radius * s->radius;
    const __m256i skip = _mm256_set1_epi32((int)s->skip), least = _mm256_set1_epi32((int)s->least);
    sph_real limits[SPHI_TILE];
    sph_index m;
    for (m = a; m < b; m += 8) {
        const int at = (int)((m - a) % SPHI_TILE);
        const __m256i j = _mm256_loadu_si256((const __m256i *)(const void *)(g->member + m));
        const __m256i drop = _mm256_or_si256(_mm256_cmpeq_epi32(j, skip), _mm256_cmpgt_epi32(least, j));
        unsigned mask;
        if (kind == SPHI_RADII && at == 0)
            sphi_limits(s, g->own + m, b - m < SPHI_TILE ? (int)((b - m + 7) / 8 * 8) : (int)SPHI_TILE,
                        limits);
        mask = sphi_nearer8(dim, g, s, m, shift, limit, kind == SPHI_RADII ? limits + at : 0) &
               ~(unsigned)_mm256_movemask_ps(_mm256_castsi256_ps(drop));
        mask &= b - m < 8 ? (1u << (b - m)) - 1u : 0xffu;
        if (store) sphi_compress8(out + count, j, mask);
        count += __builtin_popcount(mask);
    }
    return count;
}
/* The same where the room may be too small for whole lanes. This is not the portable loop, because that may
   round differently (where the compiler contracts it to fused operations), and a row would then not be as
   long as it was counted. */
SPHI_LARGE int64_t sphi_filter_tight(int dim, int kind, const sph_grid *g, const sphi_search *s,
                                     sph_vec shift, sph_index a, sph_index b, sph_index *out, int64_t room,
                                     int64_t count)
{
    for (; a < b; a += 8) {
        sph_index some[8];
        const int64_t found = sphi_filter_wide(dim, kind, g, s, shift, a, b - a < 8 ? b : a + 8, some, 1, 0);
        int64_t c;
        for (c = 0; c < found && count + c < room; c++) out[count + c] = some[c];
        count += found;
    }
    return count;
}
#endif

SPH_FN int64_t sphi_filter(int dim, int kind, const sph_grid *g, const sphi_search *s, sphi_run *run,
                           sph_index a, sph_index b, sph_index *out, int64_t room, int64_t count)
{
#if SPH_AVX512 || SPH_AVX2
    const int store = count + (int64_t)(b - a) + 8 <= room;
    if (kind != SPHI_HASHED && SPHI_WIDE_PATH) {
        run->met = 1; /* it is looked for in every row */
        if (store || room <= 0) return sphi_filter_wide(dim, kind, g, s, run->shift, a, b, out, store, count);
        return sphi_filter_tight(dim, kind, g, s, run->shift, a, b, out, room, count);
    }
#endif
    return sphi_filter_portable(dim, kind, g, s, run, a, b, out, room, count);
}

/* The cells from x - radius to x + radius along an axis. Along a periodic axis they may lie outside
   of the box. */
SPH_FN void sphi_range(sph_real x, sph_real radius, sph_real low, sph_real inverse_width, sph_real length,
                       int64_t cells, int64_t *c0, int64_t *c1)
{
    if (length > SPH_R(0)) {
        /* somewhat more than the radius, because rounding differs from image to image */
        const sph_real more = radius + SPH_R(16) * SPH_EPSILON * (length + SPHI_ABS(low));
        *c0 = sph_grid_cell_periodic(x - more, low, inverse_width);
        *c1 = sph_grid_cell_periodic(x + more, low, inverse_width);
    } else {
#ifdef __FAST_MATH__ /* the order of sums is then the compiler's */
        const sph_real more = SPH_R(16) * SPH_EPSILON * (SPHI_ABS(low) + (sph_real)cells / inverse_width);
        radius += more < radius ? more : radius;
#endif
        *c0 = sph_grid_cell(x - radius, low, inverse_width, cells);
        *c1 = sph_grid_cell(x + radius, low, inverse_width, cells);
    }
}

/* -------- lists: crowded cells. Where many particles have collapsed into a small place, rows are as long as
   the cloud. If a whole cell lies within the radius, all its particles are stored, or counted, without a look
   at each. The result is the same as by distances. */

/* The first of the slots a ... b - 1 whose particle is not below j. (The slots of a bucket are in the order
   of their particles.) */
SPH_FN sph_index sphi_lower_bound(const sph_grid *g, sph_index a, sph_index b, sph_index j)
{
    while (a < b) {
        const sph_index middle = a + (b - a) / 2;
        if (g->member[middle] < j) a = middle + 1;
        else b = middle;
    }
    return a;
}
SPH_FN sph_real sphi_source_radius(const sph_grid *g, const sphi_search *s, sph_index slot)
{
    return s->criterion == SPH_GATHER ? SPH_R(0) : g->own[slot];
}
SPH_FN void sphi_crowd_add(int dim, const sph_grid *g, const sphi_search *s, sph_index slot,
                           sphi_crowd *crowd)
{
    const sph_real radius = sphi_source_radius(g, s, slot);
    sphi_enclose(sphi_slot(dim, g, slot), &crowd->low, &crowd->high);
    if (radius < crowd->least) crowd->least = radius;
}
SPH_FN sphi_crowd sphi_crowd_of(int dim, const sph_grid *g, const sphi_search *s, size_t bucket, sph_index a,
                                sph_index b, sph_index step)
{
    sphi_crowd crowd;
    crowd.bucket = bucket;
    crowd.low = crowd.high = sphi_slot(dim, g, a);
    crowd.least = sphi_source_radius(g, s, a);
    for (; a < b - step; a += step) sphi_crowd_add(dim, g, s, a, &crowd);
    sphi_crowd_add(dim, g, s, b - 1, &crowd);
    return crowd;
}
/* The square of the distance to the farther end of an interval. */
SPH_FN sph_real sphi_farther2(sph_real p, sph_real low, sph_real high, sph_real shift)
{
    const sph_real l = SPHI_ABS((p - low) - shift), h = SPHI_ABS((p - high) - shift);
    return l > h ? l * l : h * h;
}
/* Whether all particles of a crowd are in the run and nearer than their radii. They must be nearer by so much
   that the rounding of their distances cannot change this. */
SPH_FN int sphi_crowd_near(int kind, const sph_grid *g, const sphi_search *s, const sphi_run *run,
                           const sphi_crowd *crowd)
{
    const sph_real radius = sphi_lesser(sph_grid_pair_radius(s->criterion, s->own, crowd->least), s->widest);
    const sph_vec shift = run->shift, low = crowd->low, high = crowd->high;
    sph_real d2 = sphi_farther2(s->p.x, low.x, high.x, shift.x);
    if (g->dim > 1) d2 += sphi_farther2(s->p.y, low.y, high.y, shift.y);
    if (g->dim > 2) d2 += sphi_farther2(s->p.z, low.z, high.z, shift.z);
    if (!(d2 < radius * radius * (SPH_R(1) - SPH_R(64) * SPH_EPSILON))) return 0;
    if (kind != SPHI_HASHED) return 1;
    return sphi_in_run(g->dim, g, low, run) && sphi_in_run(g->dim, g, high, run);
}
/* 1 if all particles of a bucket are known to be neighbours without a look at each, else 0. */
SPH_FN int sphi_crowd_taken(int kind, const sph_grid *g, const sphi_search *s, const sphi_run *run,
                            size_t bucket)
{
    const sph_index a = g->first[bucket], b = g->first[bucket + 1];
    sphi_crowds *const known = s->crowds;
    sphi_crowd crowd;
    int i;
    if (b - a < SPHI_CROWDED) return 0;
    /* first the bounds of a few of them, because those of a wide crowd would be of no use */
    crowd = sphi_crowd_of(g->dim, g, s, bucket, a, b, (b - a) / 4 + 1);
    if (!sphi_crowd_near(kind, g, s, run, &crowd)) return 0;
    for (i = 0; i < known->count && known->of[i].bucket != bucket; i++) {}
    if (i == known->count) {
        i = known->next;
        known->of[i] = sphi_crowd_of(g->dim, g, s, bucket, a, b, 1);
        known->next = (i + 1) % SPHI_CROWDS;
        if (i == known->count) known->count++;
    }
    return sphi_crowd_near(kind, g, s, run, &known->of[i]);
}
SPHI_LARGE int sphi_has_crowd(int kind, const sph_grid *g, const sphi_search *s, const sphi_run *run,
                              size_t from, size_t to)
{
    while (from < to && !sphi_crowd_taken(kind, g, s, run, from)) from++;
    return from < to;
}
/* Takes all slots a ... b - 1 of one bucket, as sphi_filter would, but without distances. */
SPHI_LARGE int64_t sphi_take(const sph_grid *g, const sphi_search *s, sphi_run *run, sph_index a, sph_index b,
                             sph_index *out, int64_t room, int64_t count)
{
    sph_index m = sphi_lower_bound(g, a, b, s->least);
    const sph_index own = sphi_lower_bound(g, m, b, s->skip);
    const int met = own < b && g->member[own] == s->skip;
    const int64_t end = count + (b - m) - met;
    run->met |= met;
    for (; m < b && count < room; m++) {
        out[count] = g->member[m];
        count += g->member[m] != s->skip;
    }
    return end;
}
/* One compiled copy for all dimensions and kinds, where speed does not matter. */
SPHI_LARGE int64_t sphi_filter_any(int kind, const sph_grid *g, const sphi_search *s, sphi_run *run,
                                   sph_index a, sph_index b, sph_index *out, int64_t room, int64_t count)
{
    return sphi_filter(g->dim, kind, g, s, run, a, b, out, room, count);
}
/* A run with a crowd in it. Few particles are not taken as a whole. */
SPHI_LARGE int64_t sphi_filter_crowded(int kind, const sph_grid *g, const sphi_search *s, sphi_run *run,
                                       size_t from, size_t to, sph_index *out, int64_t room, int64_t count)
{
    for (; from < to; from++) {
        const sph_index a = g->first[from], b = g->first[from + 1];
        if (sphi_crowd_taken(kind, g, s, run, from)) count = sphi_take(g, s, run, a, b, out, room, count);
        else if (a < b) count = sphi_filter_any(kind, g, s, run, a, b, out, room, count);
    }
    return count;
}
/* The consecutive buckets from ... to - 1. */
SPH_FN int64_t sphi_buckets(int dim, int kind, const sph_grid *g, const sphi_search *s, sphi_run *run,
                            size_t from, size_t to, sph_index *out, int64_t room, int64_t count)
{
    const sph_index a = g->first[from], b = g->first[to];
    if (b - a >= SPHI_CROWDED && sphi_has_crowd(kind, g, s, run, from, to))
        return sphi_filter_crowded(kind, g, s, run, from, to, out, room, count);
    return sphi_filter(dim, kind, g, s, run, a, b, out, room, count);
}

/* -------- lists: the rows of cells around a target */

/* The cells that a target looks at. Along a periodic axis they may lie outside of the box. */
typedef struct sphi_block {
    int64_t x0, x1, y0, y1, z0, z1;
    int64_t y, z; /* of the target itself */
} sphi_block;
SPH_FN sphi_block sphi_block_of(int dim, int kind, const sph_grid *g, const sphi_search *s)
{
    const int boxed = kind != SPHI_OPEN;
    const sph_vec p = s->p, box = g->box;
    sphi_block k;
    k.y0 = k.y1 = k.z0 = k.z1 = k.y = k.z = 0;
    if (dim > 1) {
        sphi_range(p.y, s->radius, g->low.y, g->inverse_width.y, boxed ? box.y : SPH_R(0), g->cells[1], &k.y0,
                   &k.y1);
        k.y = sph_grid_cell(p.y, g->low.y, g->inverse_width.y, g->cells[1]);
    }
    if (dim > 2) {
        sphi_range(p.z, s->radius, g->low.z, g->inverse_width.z, boxed ? box.z : SPH_R(0), g->cells[2], &k.z0,
                   &k.z1);
        k.z = sph_grid_cell(p.z, g->low.z, g->inverse_width.z, g->cells[2]);
    }
    sphi_range(p.x, s->radius, g->low.x, g->inverse_width.x, boxed ? box.x : SPH_R(0), g->cells[0], &k.x0,
               &k.x1);
    return k;
}
/* The image of a row, as a distance along y or z. Moves the row into the box. */
SPH_FN sph_real sphi_row_shift(sph_real length, int64_t cells, int64_t *row)
{
    int64_t image;
    if (!(length > SPH_R(0))) return SPH_R(0);
    image = sph_grid_image(cells, *row);
    *row -= image * cells;
    return length * (sph_real)image;
}

/* Finds where the rows of a block begin in the table of a hashed grid, and how far apart. */
SPHI_LARGE void sphi_rows_find(const sph_grid *g, const sphi_block *k, sphi_rows *rows)
{
    int64_t y, z;
    int count = 0, i;
    rows->y0 = k->y0;
    rows->y1 = k->y1;
    rows->z0 = k->z0;
    rows->z1 = k->z1;
    rows->apart = 0;
    if ((k->y1 - k->y0 + 1) * (k->z1 - k->z0 + 1) > SPHI_ROWS) return;
    rows->apart = g->buckets;
    for (z = k->z0; z <= k->z1; z++)
        for (y = k->y0; y <= k->y1; y++) {
            int64_t in_y = y, in_z = z;
            sphi_row_shift(g->box.y, g->cells[1], &in_y);
            sphi_row_shift(g->box.z, g->cells[2], &in_z);
            rows->from[count] = sphi_row_bucket(g, in_y, in_z);
            for (i = 0; i < count; i++) {
                const size_t ahead = (rows->from[count] - rows->from[i]) & (g->buckets - 1),
                             behind = (rows->from[i] - rows->from[count]) & (g->buckets - 1);
                if (ahead < rows->apart) rows->apart = ahead;
                if (behind < rows->apart) rows->apart = behind;
            }
            count++;
        }
}
/* 1 if the stretches of the rows in the table do not overlap, and each is in one image. No slot is then seen
   twice. Particles of other cells that are there, too, are too far away to be neighbours, in any image. */
SPH_FN int sphi_rows_apart(const sph_grid *g, const sphi_block *k, sphi_rows *rows)
{
    if (k->x0 < 0 || k->x1 >= g->cells[0]) return 0;
    if (k->y0 != rows->y0 || k->y1 != rows->y1 || k->z0 != rows->z0 || k->z1 != rows->z1)
        sphi_rows_find(g, k, rows);
    return (size_t)(k->x1 - k->x0) < rows->apart;
}
/* The rows of a hashed grid, if sphi_rows_apart. */
SPH_FN int64_t sphi_rows_hashed(int dim, const sph_grid *g, const sphi_search *s, const sphi_block *k,
                                sphi_run *run, int careful, int count_all, sph_index *out, int64_t room,
                                int64_t *candidates)
{
    const size_t cells = (size_t)(k->x1 - k->x0) + 1, *from = s->rows->from;
    int64_t y, z, count = 0;
    for (z = k->z0; z <= k->z1; z++) {
        run->z = z;
        run->shift.z = dim > 2 ? sphi_row_shift(g->box.z, g->cells[2], &run->z) : SPH_R(0);
        for (y = k->y0; y <= k->y1; y++) {
            size_t at = (*from++ + (size_t)k->x0) & (g->buckets - 1), left = cells;
            run->y = y;
            run->shift.y = dim > 1 ? sphi_row_shift(g->box.y, g->cells[1], &run->y) : SPH_R(0);
            run->own = careful || (y == k->y && z == k->z);
            while (left > 0) { /* twice if the row passes the end of the table */
                const size_t to = at + left < g->buckets ? at + left : g->buckets;
                *candidates += g->first[to] - g->first[at];
                if (!count_all && s->criterion == SPH_GATHER)
                    count = sphi_buckets(dim, SPHI_BOXED, g, s, run, at, to, out, room, count);
                else if (!count_all)
                    count = sphi_buckets(dim, SPHI_RADII, g, s, run, at, to, out, room, count);
                left -= to - at;
                at = 0;
            }
        }
    }
    return count;
}
/* The rows of an open domain, whose cells have their own buckets. It would cost more than it saves to look at
   less of the rows near the rim, or to leave them out. */
SPH_FN int64_t sphi_rows_open(int dim, const sph_grid *g, const sphi_search *s, const sphi_block *k,
                              sphi_run *run, int careful, int count_all, sph_index *out, int64_t room,
                              int64_t *candidates)
{
    int64_t y, z, count = 0;
    for (z = k->z0; z <= k->z1; z++)
        for (y = k->y0; y <= k->y1; y++) {
            const size_t row = (size_t)((z * g->held[1] + y) * g->held[0]), from = row + (size_t)k->x0,
                         to = row + (size_t)k->x1 + 1;
            run->own = careful || (y == k->y && z == k->z);
            *candidates += g->first[to] - g->first[from];
            if (!count_all) count = sphi_buckets(dim, SPHI_OPEN, g, s, run, from, to, out, room, count);
        }
    return count;
}
/* The rows of any grid. */
SPH_FN int64_t sphi_rows_any(int dim, int kind, const sph_grid *g, const sphi_search *s, const sphi_block *k,
                             sphi_run *run, int careful, int count_all, sph_index *out, int64_t room,
                             int64_t *candidates)
{
    const int hashed = kind == SPHI_HASHED;
    const sph_vec box = g->box;
    int64_t x, y, z, stretch, count = 0;
    for (z = k->z0; z <= k->z1; z++) {
        run->z = z;
        run->shift.z = dim > 2 ? sphi_row_shift(box.z, g->cells[2], &run->z) : SPH_R(0);
        if (run->z >= g->held[2]) continue;
        for (y = k->y0; y <= k->y1; y++) {
            size_t row;
            run->y = y;
            run->shift.y = dim > 1 ? sphi_row_shift(box.y, g->cells[1], &run->y) : SPH_R(0);
            if (run->y >= g->held[1]) continue;
            run->own = careful || (y == k->y && z == k->z);
            row = sphi_row_bucket(g, run->y, run->z);
            for (x = k->x0; x <= k->x1; x += stretch) { /* once, unless the row passes the end of the box */
                size_t from, left;
                run->x0 = x;
                run->shift.x = sphi_row_shift(box.x, g->cells[0], &run->x0);
                stretch = k->x1 - x < g->cells[0] - run->x0 ? k->x1 - x + 1 : g->cells[0] - run->x0;
                run->x1 = (run->x0 + stretch < g->held[0] ? run->x0 + stretch : g->held[0]) - 1;
                if (run->x0 > run->x1) continue;
                from = row + (size_t)run->x0;
                left = (size_t)(run->x1 - run->x0) + 1;
                if (hashed && left > g->buckets) left = g->buckets;
                while (left > 0) { /* twice if a hashed row passes the end of the table */
                    size_t to;
                    if (hashed) from &= g->buckets - 1;
                    to = from + left < g->buckets ? from + left : g->buckets;
                    *candidates += g->first[to] - g->first[from];
                    if (!count_all) count = sphi_buckets(dim, kind, g, s, run, from, to, out, room, count);
                    left -= to - from;
                    from = to;
                }
            }
        }
    }
    return count;
}
/* The rare case of a hashed grid, not specialised. */
SPHI_LARGE int64_t sphi_rows_overlapping(const sph_grid *g, const sphi_search *s, const sphi_block *k,
                                         sphi_run *run, int careful, int count_all, sph_index *out,
                                         int64_t room, int64_t *candidates)
{
    return sphi_rows_any(g->dim, SPHI_HASHED, g, s, k, run, careful, count_all, out, room, candidates);
}

/* -------- lists: images of a periodic box, by their numbers */

SPH_FN sph_vec sphi_image_shift(sph_vec box, int image)
{
    sph_vec shift;
    shift.x = box.x * (sph_real)(image % 3 - 1);
    shift.y = box.y * (sph_real)(image / 3 % 3 - 1);
    shift.z = box.z * (sph_real)(image / 9 - 1);
    return shift;
}
/* The first image from `image` on that differs from others: only axes with a length have images. */
SPH_FN int sphi_next_image(int dim, sph_vec box, int image)
{
    if (!sphi_boxed(dim, box)) return image <= SPHI_INSIDE ? SPHI_INSIDE : SPHI_IMAGES;
    while (image < SPHI_IMAGES && ((!(box.x > SPH_R(0)) && image % 3 != 1) ||
                                   (!(dim > 1 && box.y > SPH_R(0)) && image / 3 % 3 != 1) ||
                                   (!(dim > 2 && box.z > SPH_R(0)) && image / 9 != 1)))
        image++;
    return image;
}

/* With a radius far beyond that of the grid a target has to look at too many rows: so at all slots, in all
   images. The code is not specialised, because then most of the slots are neighbours. */
SPHI_LARGE int64_t sphi_rows_far(const sph_grid *g, const sphi_search *s, sphi_run *run, int count_all,
                                 sph_index *out, int64_t room, int64_t *candidates)
{
    const int kind = s->criterion == SPH_GATHER ? SPHI_BOXED : SPHI_RADII;
    int64_t count = 0;
    int image;
    run->own = 1;
    for (image = 0; (image = sphi_next_image(g->dim, g->box, image)) < SPHI_IMAGES; image++) {
        *candidates += g->n;
        run->shift = sphi_image_shift(g->box, image);
        if (!count_all) count = sphi_filter_any(kind, g, s, run, 0, g->n, out, room, count);
    }
    run->met = 1;
    return count;
}

/* -------- lists: the leaves of a tree around a group of targets */

/* By how much a place is outside of an interval, given its distance from the middle. */
SPH_FN sph_real sphi_outside(sph_real distance, sph_real half_length)
{
    const sph_real d = SPHI_ABS(distance) - half_length;
    return SPH_R(0.5) * (d + SPHI_ABS(d));
}
/* By how much rounding may change a distance in a tree. */
SPH_FN sph_real sphi_slack(const sph_grid *g)
{
    const sph_real *const root = sphi_node(g, 1), box[3] = {g->box.x, g->box.y, g->box.z};
    sph_real size = SPH_R(0);
    int c;
    for (c = 0; c < g->dim; c++) size += SPHI_ABS(root[c]) + root[g->dim + c] + box[c];
    return SPH_R(16) * SPH_EPSILON * size;
}
/* Finds the leaves that the group may see, from where the view stands, until it is full. A node is left out
   with all below it if it is farther away than the largest radius of a pair with one of its sources. */
SPHI_LARGE void sphi_view_fill(const sph_grid *g, const sphi_search *s, sphi_view *v)
{
    const int64_t leaves = (int64_t)1 << (g->levels - 1);
    const int dim = g->dim;
    int l;
    v->count = 0;
    for (; (v->image = sphi_next_image(dim, g->box, v->image)) < SPHI_IMAGES; v->image++) {
        const sph_vec shift = sphi_image_shift(g->box, v->image);
        if (v->next == 0) v->next = 1;
        do {
            const sph_real *const node = sphi_node(g, v->next), *const half_length = node + dim;
            const sph_real x = node[0] + shift.x, y = dim > 1 ? node[1] + shift.y : SPH_R(0),
                           z = dim > 2 ? node[2] + shift.z : SPH_R(0);
            const sph_real dx = half_length[0] + v->slack,
                           dy = dim > 1 ? half_length[1] + v->slack : SPH_R(0),
                           dz = dim > 2 ? half_length[2] + v->slack : SPH_R(0);
            const sph_real a = sphi_outside(v->p.x - x, v->half_length.x + dx),
                           b = sphi_outside(v->p.y - y, v->half_length.y + dy),
                           c = sphi_outside(v->p.z - z, v->half_length.z + dz);
            const sph_real pair =
                sphi_lesser(sph_grid_pair_radius(s->criterion, v->own, node[2 * dim]), s->widest);
            if (a * a + b * b + c * c <= pair * pair * (SPH_R(1) + SPH_R(16) * SPH_EPSILON)) {
                if (v->next < leaves) {
                    v->next *= 2;
                    continue;
                }
                if (v->count == SPHI_VIEW) return;
                l = v->count++;
                v->seen_in[l] = (signed char)v->image;
                v->leaf[l] = (sph_index)(v->next - leaves);
                v->x[l] = x;
                v->y[l] = y;
                v->z[l] = z;
                v->dx[l] = dx;
                v->dy[l] = dy;
                v->dz[l] = dz;
                v->largest[l] = node[2 * dim];
            }
            v->next++; /* to the next branch, or from the last one to node 1 */
            while (v->next % 2 == 0) v->next /= 2;
        } while (v->next != 1);
        v->next = 0;
    }
    for (l = v->count; l % SPHI_BLOCK != 0; l++) /* whole lanes are read, but not used */
        v->x[l] = v->y[l] = v->z[l] = v->dx[l] = v->dy[l] = v->dz[l] = v->largest[l] = SPH_R(0);
}
/* The neighbours of a target in the leaves of a view. */
SPH_FN int64_t sphi_view_row(int dim, const sph_grid *g, const sphi_search *s, sphi_run *run, int careful,
                             sph_index *out, int64_t room, int64_t count)
{
    const sphi_view *const v = s->view;
    const int level = g->levels - 1;
    sph_real limit[SPHI_VIEW], excess[SPHI_VIEW];
    int hit[SPHI_VIEW], hits = 0, c, l;
    if (v->count == 0) return count;
    sphi_limits(s, v->largest, (v->count + SPHI_BLOCK - 1) / SPHI_BLOCK * SPHI_BLOCK, limit);
    for (c = 0; c < v->count; c += SPHI_BLOCK)
        for (l = c; l < c + SPHI_BLOCK; l++) {
            const sph_real dx = sphi_outside(s->p.x - v->x[l], v->dx[l]);
            const sph_real dy = dim > 1 ? sphi_outside(s->p.y - v->y[l], v->dy[l]) : SPH_R(0);
            const sph_real dz = dim > 2 ? sphi_outside(s->p.z - v->z[l], v->dz[l]) : SPH_R(0);
            const sph_real d2 = dx * dx + (dim > 1 ? dy * dy : SPH_R(0)) + (dim > 2 ? dz * dz : SPH_R(0));
            limit[l] *= SPH_R(1) + SPH_R(16) * SPH_EPSILON;
            excess[l] = d2 - limit[l];
        }
    for (c = 0; c < v->count; c++) { /* without a branch */
        hit[hits] = c;
        hits += (int)sphi_negative(excess[c]);
    }
    for (c = 0; c < hits;) {
        const int first = hit[c];
        sph_index from = sphi_cut(g->n, level, v->leaf[first]), to;
        int last = first;
        run->own = careful;
        do { /* leaves that follow each other are one run */
            last = hit[c++];
            run->own |= excess[last] == -limit[last]; /* the target is in there */
        } while (c < hits && v->leaf[hit[c]] == v->leaf[last] + 1 && v->seen_in[hit[c]] == v->seen_in[last]);
        to = sphi_cut(g->n, level, (int64_t)v->leaf[last] + 1);
        run->shift = sphi_image_shift(g->box, v->seen_in[first]);
        if (s->criterion == SPH_GATHER)
            count = sphi_filter(dim, SPHI_BOXED, g, s, run, from, to, out, room, count);
        else count = sphi_filter(dim, SPHI_RADII, g, s, run, from, to, out, room, count);
    }
    return count;
}
/* The neighbours of a target in a tree. If the view has no room for all leaves, the target is a group by
   itself, and looks at some leaves after the other. */
SPH_FN int64_t sphi_tree_row(int dim, const sph_grid *g, const sphi_search *s, sphi_run *run, int careful,
                             sph_index *out, int64_t room)
{
    sphi_view *const v = s->view;
    const int all = v->image == SPHI_IMAGES;
    int64_t count = 0;
    int last;
    do {
        last = v->image == SPHI_IMAGES;
        count = sphi_view_row(dim, g, s, run, careful || !all, out, room, count);
        if (!last) sphi_view_fill(g, s, v);
    } while (!last);
    run->met |= !all;
    return count;
}

/* The neighbours of one target, or with count_all the number of candidates alone. Adds the number of
   candidates to *candidates. The target itself is looked for in the row of its own cell only, or in the leaf
   around it. If it was not there, because the caller has moved it since the grid was built, all is done again
   with more care. */
SPH_FN int64_t sphi_row(int dim, int kind, const sph_grid *g, const sphi_search *s, int count_all,
                        sph_index *out, int64_t room, int64_t *candidates)
{
    sphi_block k;
    sphi_run run;
    int64_t count;
    int careful = 0;
    run.y = run.z = 0;
    run.shift.x = run.shift.y = run.shift.z = SPH_R(0);
    run.met = s->skip < 0 || count_all;
    if (kind == SPHI_TREE) {
        *candidates += g->n;
        if (count_all) return 0;
    } else {
        if (s->radius > SPH_R(SPHI_FARTHEST) * g->radius)
            return sphi_rows_far(g, s, &run, count_all, out, room, candidates);
        k = sphi_block_of(dim, kind, g, s);
    }
    do {
        if (kind == SPHI_TREE) count = sphi_tree_row(dim, g, s, &run, careful, out, room);
        else if (kind == SPHI_OPEN)
            count = sphi_rows_open(dim, g, s, &k, &run, careful, count_all, out, room, candidates);
        else if (kind != SPHI_HASHED)
            count = sphi_rows_any(dim, kind, g, s, &k, &run, careful, count_all, out, room, candidates);
        else if (sphi_rows_apart(g, &k, s->rows))
            count = sphi_rows_hashed(dim, g, s, &k, &run, careful, count_all, out, room, candidates);
        else count = sphi_rows_overlapping(g, s, &k, &run, careful, count_all, out, room, candidates);
    } while (!run.met && !careful++);
    return count;
}

/* By what a row is sorted: the key of a source, or its number if there are no keys. */
SPH_FN int64_t sphi_key(const int64_t *key, sph_index j) { return key ? key[j] : j; }
/* Sorts a row in ascending order. It is a heapsort, because a row of a collapsed cloud may be long. */
SPH_FN void sphi_sort(sph_index *a, sph_index n, const int64_t *key)
{
    sph_index i, parent, child, v;
    for (i = n / 2; n > 1;) {
        if (i > 0) v = a[--i];
        else {
            v = a[--n];
            a[n] = a[0];
        }
        parent = i;
        while ((child = 2 * parent + 1) < n) {
            if (child + 1 < n && sphi_key(key, a[child + 1]) > sphi_key(key, a[child])) child++;
            if (sphi_key(key, a[child]) <= sphi_key(key, v)) break;
            a[parent] = a[child];
            parent = child;
        }
        a[parent] = v;
    }
}

/* What a call of sph_grid_lists or sph_grid_count has to do. */
typedef struct sphi_job sphi_job;
typedef int64_t (*sphi_pass_function)(int mode, const sphi_job *job, sph_index first, sph_index last,
                                      sph_index *index, int64_t room, int64_t *candidates);
struct sphi_job {
    const sph_grid *g;
    sph_points targets;
    sphi_pass_function pass;
    sph_index number; /* target 0 is the source with this number */
    int kind, flags;
    int criterion; /* of the query */
    int plain;     /* the radius of a pair depends on the target alone */
    sph_scalars radius;
    sph_real widest;
    sph_real slack;   /* of a tree: by how much rounding may change a distance */
    int by_slots;     /* passes go over the slots of the grid, not over the targets */
    int64_t capacity; /* 0: nothing is stored */
    sph_index *start, *index;
};

/* SPHI_APPEND stores the rows one after the other in index[0 ... room - 1], and their lengths in
   start[i + 1]. The other way takes two passes: SPHI_LENGTHS stores the lengths in start[i + 1]; once
   these have become starts, SPHI_PLACE stores each row where it belongs. This is for targets that are
   stored in an order far from that of the grid. They are visited in the order of the slots, where
   near targets follow each other. */
enum { SPHI_APPEND, SPHI_LENGTHS, SPHI_PLACE, SPHI_BUFFER = 512 };

/* The target at place k of a pass. Returns its number among the targets, or -1 if it is a source only. */
SPH_FN sph_index sphi_target(int dim, int kind, const sphi_job *job, sph_index k, sphi_search *s)
{
    const sph_grid *const g = job->g;
    const sph_index i = job->by_slots ? g->member[k] - job->number : k, source = i + job->number;
    if (i < 0 || i >= job->targets.n) return -1;
    s->p = job->by_slots ? sphi_slot(dim, g, k)
                         : sphi_wrap_point(dim, sphi_point(dim, job->targets, i), g->low, g->box);
    s->own = job->criterion == SPH_SCATTER ? SPH_R(0) : sphi_at(job->radius, i);
    if (job->plain) s->own = sph_grid_pair_radius(job->criterion, s->own, g->largest);
    s->radius = kind > SPHI_RADII ? s->own : sph_grid_pair_radius(s->criterion, s->own, g->largest);
    s->radius = sphi_lesser(s->radius, s->widest);
    s->skip = job->flags & (SPH_LIST_SELF | SPH_LIST_FOREIGN) ? -1 : source;
    s->least = job->flags & SPH_LIST_HALF ? source : 0;
    return i;
}
/* Makes a group of s, the target at place k, and those that follow and are near, and finds the leaves that
   they may see. If there is no room for all leaves, the group is made smaller. */
SPHI_LARGE void sphi_view_begin(int dim, const sphi_job *job, sph_index k, sph_index last,
                                const sphi_search *s)
{
    sphi_view *const v = s->view;
    sph_index most = last - k < SPHI_LEAF ? last - k : SPHI_LEAF;
    do {
        sphi_search other = *s;
        sph_vec low = s->p, high = s->p;
        v->own = s->own;
        for (v->until = k + 1; v->until < k + most; v->until++) {
            sph_vec l = low, h = high;
            sph_real wide;
            if (sphi_target(dim, SPHI_TREE, job, v->until, &other) < 0) continue;
            sphi_enclose(other.p, &l, &h);
            wide = SPH_R(1.5) * (job->criterion == SPH_SCATTER ? job->g->radius : other.own);
            if (other.own > SPH_R(2) * s->own || h.x - l.x > wide || h.y - l.y > wide || h.z - l.z > wide)
                break;
            low = l;
            high = h;
            v->own = other.own > v->own ? other.own : v->own;
        }
        v->p.x = SPH_R(0.5) * low.x + SPH_R(0.5) * high.x;
        v->p.y = SPH_R(0.5) * low.y + SPH_R(0.5) * high.y;
        v->p.z = SPH_R(0.5) * low.z + SPH_R(0.5) * high.z;
        v->half_length.x = SPH_R(0.5) * (high.x - low.x);
        v->half_length.y = SPH_R(0.5) * (high.y - low.y);
        v->half_length.z = SPH_R(0.5) * (high.z - low.z);
        v->image = 0;
        v->next = 0;
        sphi_view_fill(job->g, s, v);
        most = (v->until - k) / 2;
    } while (v->image < SPHI_IMAGES && most > 0);
}

/* One compiled copy serves all three modes, so that a row is placed with the same rounding with which it was
   counted: PLACE reads start, which holds what LENGTHS or APPEND counted. Returns the sum of the lengths,
   none of them estimated. Adds the number of candidates, which is never less, to *candidates. Once the sum is
   more than sph_index can count there will be no list, and only candidates are counted from then on. view is
   for a tree. */
SPH_FN int64_t sphi_pass(int dim, int kind, sphi_view *view, int mode, const sphi_job *job, sph_index first,
                         sph_index last, sph_index *index, int64_t room, int64_t *candidates)
{
    const sph_grid *const g = job->g;
    int64_t total = 0;
    sph_index buffer[SPHI_BUFFER], k;
    sphi_crowds crowds;
    sphi_rows rows;
    sphi_search s;
    crowds.count = crowds.next = 0;
    s.crowds = &crowds;
    rows.y0 = rows.z0 = 0;
    rows.y1 = rows.z1 = -1; /* none yet */
    s.rows = &rows;
    if (kind == SPHI_TREE) {
        view->until = first;
        view->slack = job->slack;
    }
    s.view = view;
    s.widest = job->widest;
    s.criterion = job->plain ? (int)SPH_GATHER : job->criterion;
    for (k = first; k < last; k++) {
        const int64_t left = mode == SPHI_APPEND && room > total ? room - total : 0;
        int64_t count;
        sph_index *row = index, p, i;
        int64_t row_room = left;
        int buffered;
        i = sphi_target(dim, kind, job, k, &s);
        if (i < 0) continue;
        if (kind == SPHI_TREE && k >= view->until && total <= SPHI_INDEX_MAX)
            sphi_view_begin(dim, job, k, last, &s);
        if (left > 0) row = index + total;
        if (mode == SPHI_PLACE) { /* by way of the buffer, which has room for whole lanes */
            row_room = job->start[i + 1] - job->start[i];
            row = index + job->start[i];
        }
        buffered = mode == SPHI_PLACE && row_room <= SPHI_BUFFER / 2;
        count = sphi_row(dim, kind, g, &s, total > SPHI_INDEX_MAX, buffered ? buffer : row,
                         buffered ? (int64_t)SPHI_BUFFER : row_room, candidates);
        SPH_ASSERT(mode != SPHI_PLACE || count == row_room);
        for (p = 0; buffered && p < (sph_index)row_room; p++) row[p] = buffer[p];
        if (mode != SPHI_LENGTHS && (job->flags & SPH_LIST_SORTED) && count <= row_room)
            sphi_sort(row, (sph_index)count, 0);
        if (mode != SPHI_PLACE) {
            SPH_ASSERT(count <= g->n);
            total += count;
            job->start[i + 1] = (sph_index)count;
        }
    }
    return total;
}
#define SPHI_PASS(name, dim, kind) \
    SPHI_LARGE int64_t name(int mode, const sphi_job *job, sph_index first, sph_index last, \
                            sph_index *index, int64_t room, int64_t *candidates) \
    { \
        return sphi_pass(dim, kind, 0, mode, job, first, last, index, room, candidates); \
    }
#define SPHI_TREE_PASS(name, dim) \
    SPHI_LARGE int64_t name(int mode, const sphi_job *job, sph_index first, sph_index last, \
                            sph_index *index, int64_t room, int64_t *candidates) \
    { \
        sphi_view view; \
        return sphi_pass(dim, SPHI_TREE, &view, mode, job, first, last, index, room, candidates); \
    }
SPHI_TREE_PASS(sphi_pass_tree_1, 1)
SPHI_TREE_PASS(sphi_pass_tree_2, 2)
SPHI_TREE_PASS(sphi_pass_tree_3, 3)
SPHI_PASS(sphi_pass_hashed_1, 1, SPHI_HASHED)
SPHI_PASS(sphi_pass_hashed_2, 2, SPHI_HASHED)
SPHI_PASS(sphi_pass_hashed_3, 3, SPHI_HASHED)
SPHI_PASS(sphi_pass_radii_1, 1, SPHI_RADII)
SPHI_PASS(sphi_pass_radii_2, 2, SPHI_RADII)
SPHI_PASS(sphi_pass_radii_3, 3, SPHI_RADII)
SPHI_PASS(sphi_pass_boxed_1, 1, SPHI_BOXED)
SPHI_PASS(sphi_pass_boxed_2, 2, SPHI_BOXED)
SPHI_PASS(sphi_pass_boxed_3, 3, SPHI_BOXED)
SPHI_PASS(sphi_pass_open_1, 1, SPHI_OPEN)
SPHI_PASS(sphi_pass_open_2, 2, SPHI_OPEN)
SPHI_PASS(sphi_pass_open_3, 3, SPHI_OPEN)
#undef SPHI_PASS
#undef SPHI_TREE_PASS
/* The passes of one dimension: a caller for whom it is a constant gets no other ones into the program. */
SPH_FN sphi_pass_function sphi_pass_of(int dim, int kind)
{
#define SPHI_PASSES(d) \
    if (dim == d) \
        return kind == SPHI_TREE     ? sphi_pass_tree_##d \
               : kind == SPHI_HASHED ? sphi_pass_hashed_##d \
               : kind == SPHI_RADII  ? sphi_pass_radii_##d \
               : kind == SPHI_BOXED  ? sphi_pass_boxed_##d \
                                     : sphi_pass_open_##d;
    SPHI_PASSES(1)
    SPHI_PASSES(2)
    SPHI_PASSES(3)
#undef SPHI_PASSES
    return 0;
}

/* Where the room of a part begins. */
SPH_FN int64_t sphi_from(int64_t room, int part, int parts)
{
    return part < parts ? room / parts * part : room;
}

/* A pass by all threads. Each part appends to its own part of index, or places rows where start says. *spilt
   is 1 if a part of index was too small; all rows are counted even then. */
SPHI_LARGE int64_t sphi_pass_threads(int mode, const sphi_job *job, int parts, int *spilt,
                                     int64_t *candidates)
{
    const sph_index n = job->by_slots ? job->g->n : job->targets.n;
    int64_t total = 0, seen = 0;
    int part, over = 0;
#if SPH_OPENMP
#pragma omp parallel for schedule(static, 1) reduction(+ : total, seen) reduction(| : over)
#endif
    for (part = 0; part < parts; part++) {
        const int64_t from = mode == SPHI_APPEND ? sphi_from(job->capacity, part, parts) : 0;
        const int64_t room =
            mode == SPHI_APPEND ? sphi_from(job->capacity, part + 1, parts) - from : job->capacity;
        int64_t looked_at = 0;
        const int64_t mine = job->pass(mode, job, sphi_first(n, part, parts), sphi_first(n, part + 1, parts),
                                       job->capacity > 0 ? job->index + from : job->index, room, &looked_at);
        total += mine;
        seen += looked_at;
        over |= mine > room;
    }
    *spilt = over;
    *candidates = seen;
    return total;
}

/* Moves entries down. The threads share as many entries at a time as the gap is wide, and not more, because
   one of them could then overwrite an entry that another has not read yet. */
SPHI_LARGE void sphi_close_gap(sph_index *to, const sph_index *from, int64_t length, int parts)
{
    const int64_t gap = from - to;
    const int shares = gap < 16384 ? 1 : parts;
    while (gap > 0 && length > 0) {
        const int64_t step = shares == 1 || length < gap ? length : gap;
        int share;
#if SPH_OPENMP
#pragma omp parallel for schedule(static, 1)
#endif
        for (share = 0; share < shares; share++) {
            const int64_t end = sphi_from(step, share + 1, shares);
            int64_t p;
            for (p = sphi_from(step, share, shares); p < end; p++) to[p] = from[p];
        }
        to += step;
        from += step;
        length -= step;
    }
}

/* Returns the number of pairs. If that is more than sph_index can count, it returns the number of candidates
   instead. This is never less, and does not depend on how the targets were shared among threads. */
SPHI_LARGE int64_t sphi_lists(const sphi_job *job)
{
    const sph_index n = job->targets.n;
    const int parts = sphi_parts(), append = job->capacity > 0 && !job->by_slots;
    sph_index *const start = job->start, i;
    int64_t candidates;
    int spilt, part;
    const int64_t total =
        sphi_pass_threads(append ? SPHI_APPEND : SPHI_LENGTHS, job, parts, &spilt, &candidates);
    if (total > SPHI_INDEX_MAX) return candidates;
    if (job->capacity > 0 && total > job->capacity) return total;
    start[0] = 0;
    for (i = 0; i < n; i++) start[i + 1] += start[i];
    SPH_ASSERT(start[n] == total); /* every target was counted once */
    if (job->capacity == 0) return total;
    if (!append || spilt) sphi_pass_threads(SPHI_PLACE, job, parts, &spilt, &candidates);
    else
        for (part = 1; part < parts; part++) { /* moves each part down to the end of the one before */
            const sph_index begin = start[sphi_first(n, part, parts)],
                            length = start[sphi_first(n, part + 1, parts)] - begin;
            sphi_close_gap(job->index + begin, job->index + sphi_from(job->capacity, part, parts), length,
                           parts);
        }
    return total;
}

/* What is looked for: the neighbours of these targets, by this criterion, in lists with these flags. radius:
   the support radius R_i of each target, or one for all (sph_scalars_same); SPH_SCATTER does not read it.
   Those of the sources, R_j, are the grid's. */
typedef struct sph_query {
    sph_points targets;
    int criterion; /* an sph_criterion */
    sph_scalars radius;
    int flags;       /* of sph_list_flags, added up */
    sph_index first; /* target 0 is this source, target 1 the next, and so on; not with SPH_LIST_FOREIGN */
} sph_query;

/* The neighbours of points among themselves: one radius for each particle, or one for all; flags of
   sph_list_flags, added up. */
SPH_FN sph_query sph_query_of(sph_points points, int criterion, sph_scalars radius, int flags)
{
    sph_query q;
    q.targets = points;
    q.criterion = criterion;
    q.radius = radius;
    q.flags = flags;
    q.first = 0;
    return q;
}

/* Of the targets of a query those from first to last - 1: for a host that shares the search among its own
   threads, or whose own particles lie behind others. Their rows are the same as without the range, and begin
   at start[0] = 0. Needs 0 <= first <= last <= query.targets.n; else the query has no targets that are
   allowed, and is refused. */
SPH_FN sph_query sph_query_range(sph_query query, sph_index first, sph_index last)
{
    if (first < 0 || first > last || last > query.targets.n) {
        query.targets.n = -1;
        return query;
    }
    if (first > 0) {
        const size_t skipped = (size_t)first * query.targets.stride;
        if (query.targets.x) query.targets.x += skipped;
        if (query.targets.y) query.targets.y += skipped;
        if (query.targets.z) query.targets.z += skipped;
        if (query.radius.p) query.radius.p += (size_t)first * query.radius.stride;
    }
    query.targets.n = last - first;
    query.first += first;
    return query;
}

/* Checks what is asked for and makes a job of it, still without the room for its lists. */
SPH_FN int sphi_job_of(int dim, const sph_grid *grid, sph_query query, sph_index *start, sphi_job *job)
{
    const sph_scalars radius = query.radius;
    const int criterion = query.criterion, flags = query.flags;
    sph_points targets = query.targets;
    const int by_source = criterion != SPH_GATHER, by_target = criterion != SPH_SCATTER;
    const int known = SPH_LIST_SELF | SPH_LIST_HALF | SPH_LIST_SORTED | SPH_LIST_FOREIGN;
    sph_real largest;
    sph_index i;
    int error;
    if (grid && grid->dim != dim) return sphi_refuse("dim", -1, SPH_ERROR_DIM);
    if (grid && !(flags & SPH_LIST_FOREIGN) &&
        (query.first < 0 || query.first > grid->n || targets.n > grid->n - query.first))
        return sphi_refuse("query.targets.n, first", -1, SPH_ERROR_RANGE);
    error = sphi_check_points(dim, targets);
    if (error) return error;
    if (!grid || !start) return sphi_refuse("grid, start", -1, SPH_ERROR_NULL);
    if (criterion < (int)SPH_GATHER || criterion > (int)SPH_MEAN)
        return sphi_refuse("query.criterion", -1, SPH_ERROR_VALUE);
    if (flags & ~known) return sphi_refuse("query.flags", -1, SPH_ERROR_VALUE);
    if ((flags & SPH_LIST_FOREIGN) && (flags & (SPH_LIST_SELF | SPH_LIST_HALF)))
        return sphi_refuse("query.flags", -1, SPH_ERROR_VALUE);
    job->g = grid;
    job->targets = targets;
    job->number = query.first;
    job->start = start;
    job->index = 0;
    job->capacity = 0;
    job->by_slots = grid->scattered && !(flags & SPH_LIST_FOREIGN) && targets.n > grid->n / 4;
    if (targets.n == 0 || grid->n == 0) return 0; /* nothing to look at */
    if (by_target && !radius.p) return sphi_refuse("query.radius", -1, SPH_ERROR_NULL);
    largest = by_source ? grid->largest : SPH_R(0);
    for (i = 0; by_target && i < (radius.stride ? targets.n : 1); i++) {
        const sph_real own = sphi_at(radius, i);
        if (!sphi_radius_ok(own)) return sphi_refuse("query.radius", i, SPH_ERROR_H);
        if (own > largest) largest = own;
    }
    targets.box = job->targets.box = grid->box;
    if (sphi_check_box(dim, targets, largest, 0)) return SPH_ERROR_BOX;

    job->plain = !by_source || !grid->own;
    if (grid->levels) job->kind = SPHI_TREE;
    else if (grid->hashed) job->kind = SPHI_HASHED;
    else if (!job->plain) job->kind = SPHI_RADII;
    else job->kind = sphi_boxed(dim, grid->box) ? SPHI_BOXED : SPHI_OPEN;
    job->pass = sphi_pass_of(dim, job->kind);
    job->criterion = criterion;
    job->flags = flags;
    job->radius = radius;
    job->slack = grid->levels ? sphi_slack(grid) : SPH_R(0);
    job->widest = largest;
    if (grid->box.x > SPH_R(0)) job->widest = sphi_lesser(job->widest, SPH_R(0.5) * grid->box.x);
    if (dim > 1 && grid->box.y > SPH_R(0)) job->widest = sphi_lesser(job->widest, SPH_R(0.5) * grid->box.y);
    if (dim > 2 && grid->box.z > SPH_R(0)) job->widest = sphi_lesser(job->widest, SPH_R(0.5) * grid->box.z);
    return 0;
}
/* Does the job. Its answer is that of sph_grid_lists and sph_grid_count. */
SPH_FN sph_index sphi_job_do(const sphi_job *job, int64_t *pairs)
{
    sph_index i;
    if (job->targets.n == 0 || job->g->n == 0) {
        for (i = 0; i <= job->targets.n; i++) job->start[i] = 0;
        return 0;
    }
    *pairs = sphi_lists(job);
    return *pairs > SPHI_INDEX_MAX ? SPH_ERROR_PAIRS : 0;
}

/* The neighbour lists of the n = query.targets.n targets: start[0 ... n], and for target i the entries
   index[start[i]] ... index[start[i + 1] - 1]. Unless query.flags has SPH_LIST_FOREIGN, target i is source
   query.first + i (the targets may be some of the sources). index has room for capacity entries, of which
   those beyond *pairs may be overwritten; it may be null if capacity is 0. *pairs is the number of entries of
   the lists. It is set on every return, to 0 if nothing is known. Without targets start[0] is set to 0, and
   without sources all of start is; the radii may then be null.
   Returns 0 or a negative sph_error.
   SPH_ERROR_CAPACITY: index has room for fewer than *pairs entries, which is their exact number. start and
   index then hold nothing of use, and nothing beyond capacity was written.
   SPH_ERROR_PAIRS: there are more pairs than sph_index can count, so that start cannot hold their number.
   *pairs is then an upper bound of it. As above, start and index hold nothing of use.
   SPH_ERROR_BOX: a radius is more than half of a periodic box.
   SPH_ERROR_H: a radius is not within 1e-150 ... 1e150 (in float 1e-18 ... 1e18), where its square is still a
   number. On these and all other errors nothing is written but *pairs. */
SPH_FN sph_index sph_grid_lists(int dim, const sph_grid *grid, sph_query query, sph_index *start,
                                sph_index *index, int64_t capacity, int64_t *pairs)
{
    sphi_job job;
    sph_index error;
    if (pairs) *pairs = 0;
    error = sphi_job_of(dim, grid, query, start, &job);
    if (error) return error;
    if (capacity < 0) return sphi_refuse("capacity", -1, SPH_ERROR_VALUE);
    if (!pairs || (!index && capacity > 0 && query.targets.n > 0))
        return sphi_refuse("index, pairs", -1, SPH_ERROR_NULL);
    job.index = index;
    job.capacity = capacity;
    error = sphi_job_do(&job, pairs);
    return !error && *pairs > capacity ? SPH_ERROR_CAPACITY : error;
}

/* Only counts: fills start[0 ... n] and *pairs as sph_grid_lists would, so that *pairs entries are enough for
   its index. The errors are those of sph_grid_lists, without SPH_ERROR_CAPACITY. */
SPH_FN sph_index sph_grid_count(int dim, const sph_grid *grid, sph_query query, sph_index *start,
                                int64_t *pairs)
{
    sphi_job job;
    sph_index error;
    if (pairs) *pairs = 0;
    error = sphi_job_of(dim, grid, query, start, &job);
    if (error) return error;
    return pairs ? sphi_job_do(&job, pairs) : sphi_refuse("pairs", -1, SPH_ERROR_NULL);
}

/* ================================================================ the search in one call */

/* What a search finds. list and grid lie in the block of memory that the search was given, and may be used as
   long as it exists: for a cloud, for sph_grid_permutation, and for sph_grid_lists of other targets. */
typedef struct sph_neighbors {
    int64_t pairs; /* entries of the list; after SPH_ERROR_CAPACITY, how many there must be room for */
    sph_list list; /* null pointers where there is none */
    sph_grid grid; /* empty where there is none */
} sph_neighbors;

/* Bytes of a block for the grid and the lists of n particles with so many pairs. It is 0 if dim is not 1, 2
   or 3, if n or pairs is negative, or if no block can be so large. */
SPH_FN size_t sph_search_size(int dim, sph_index n, int64_t pairs)
{
    const size_t work = sph_grid_workspace(dim, n);
    if (work == 0 || pairs < 0 || pairs > SPHI_INDEX_MAX) return 0;
    if ((uint64_t)n + 1 + (uint64_t)pairs > (SIZE_MAX - work) / sizeof(sph_index)) return 0;
    return work + ((size_t)n + 1 + (size_t)pairs) * sizeof(sph_index);
}
/* How many pairs to have room for if nothing is known: 8, 32 or 128 for each particle, and not more than
   all pairs there are. */
SPH_FN int64_t sphi_search_guess(int dim, sph_index n)
{
    const int64_t others = n - 1, each = dim == 1 ? 8 : dim == 2 ? 32 : 128;
    const int64_t pairs = n * (others < each ? others : each);
    return sph_search_size(dim, n, pairs) ? pairs : 0;
}
/* Finds the neighbours of all points in one call. Grid and lists are in one block of memory, which has `size`
   bytes and may be aligned in any way. No point is its own neighbour. radius: support radii (kernel support
   times h), one for each particle, or one for all (sph_scalars_same). The block may be empty at first (null,
   0), and may be used again and again: what it holds does not matter before a call, and is of no use after an
   error. *found is set on every return. After an error it has no list and an empty grid, and pairs is 0 if
   nothing is known. Without points there is no list either, and the answer is 0.
   Returns 0 or a negative sph_error.
   SPH_ERROR_CAPACITY: the block is too small. sph_search_size(dim, points.n, found->pairs) bytes are enough.
   If there was no room for the grid, found->pairs is a guess: 8, 32 or 128 for each point in 1, 2 or 3
   dimensions. If you enlarge the block and call again, three calls are enough in every case.
   SPH_ERROR_PAIRS: there are more pairs than sph_index can count, or than a block can hold.
   SPH_ERROR_H and SPH_ERROR_BOX: as for sph_grid_lists. On these and all other errors the block is not
   touched. */
SPH_FN sph_index sph_search(int dim, sph_points points, sph_scalars radius, int criterion, void *memory,
                            size_t size, sph_neighbors *found)
{
    const size_t fixed = sph_search_size(dim, points.n, 0), work = sph_grid_workspace(dim, points.n);
    const size_t left = size > fixed ? (size - fixed) / sizeof(sph_index) : 0;
    const int64_t room = left < (size_t)SPHI_INDEX_MAX ? (int64_t)left : SPHI_INDEX_MAX;
    sph_real mean, largest;
    sph_index error, *start, *index;
    int alike;
    if (!found) return sphi_refuse("found", -1, SPH_ERROR_NULL);
    found->pairs = 0;
    found->list.start = found->list.index = 0;
    sphi_grid_empty(dim, &found->grid);
    error = sphi_check_points(dim, points);
    if (error) return error;
    if (criterion < (int)SPH_GATHER || criterion > (int)SPH_MEAN)
        return sphi_refuse("criterion", -1, SPH_ERROR_VALUE);
    if (points.n == 0) return 0;
    if (!memory && size > 0) return sphi_refuse("memory", -1, SPH_ERROR_NULL);
    if (fixed == 0) return sphi_refuse("points.n", -1, SPH_ERROR_COUNT);
    error = sphi_radii(points.n, radius, &mean, &largest, &alike);
    if (error) return error;
    if (sphi_check_box(dim, points, largest, 0)) return SPH_ERROR_BOX;
    if (size < fixed) {
        found->pairs = sphi_search_guess(dim, points.n);
        return SPH_ERROR_CAPACITY;
    }
    sphi_grid_make(dim, points, radius, mean, largest, alike, memory, &found->grid);
    start = (sph_index *)(void *)((char *)sphi_aligned(memory) + (work - SPHI_ALIGN));
    index = start + points.n + 1;
    error = sph_grid_lists(dim, &found->grid, sph_query_of(points, criterion, radius, 0), start, index, room,
                           &found->pairs);
    if (error) {
        const int too_many = sph_search_size(dim, points.n, found->pairs) == 0;
        sphi_grid_empty(dim, &found->grid);
        return error == SPH_ERROR_CAPACITY && too_many ? SPH_ERROR_PAIRS : error;
    }
    found->list.start = start;
    found->list.index = index;
    return 0;
}

/* ================================================================ parts of a cloud, on several machines
 *
 * Each machine owns some particles, its targets. It needs copies of those of the others that are neighbours
 * of its targets: they stand behind its own ones, and are sources only. What goes where is the host's
 * business; which particles are needed is decided here:
 *
 *     sph_part_of(dim, own, radius, &mine);                      where my targets are, and how far they reach
 *     ... each machine tells the others its sph_part ...
 *     sph_select_near(dim, own, radius, criterion, part[k], chosen, &count);      what part k needs of mine
 *
 * A copy is sent once, and as it is: a periodic box finds its images.
 */

/* Where the points of a part are, and how far their radii reach: two boxes along the axes. low > high if the
   part is empty. Numbers only, so that it can be sent to other machines. */
typedef struct sph_part {
    sph_vec low, high, reach_low, reach_high;
} sph_part;

SPH_FN int sphi_part_ok(int dim, sph_part part)
{
    if (!sphi_finite(part.low.x + part.high.x + part.reach_low.x + part.reach_high.x)) return 0;
    if (dim > 1 && !sphi_finite(part.low.y + part.high.y + part.reach_low.y + part.reach_high.y)) return 0;
    return dim < 3 || sphi_finite(part.low.z + part.high.z + part.reach_low.z + part.reach_high.z);
}
/* Rows of n targets that name n_total sources, of which the targets may be some. */
SPH_FN int sphi_check_part_rows(sph_index n, sph_index n_total, const sph_index *start,
                                const sph_index *index)
{
    sph_list list;
    if (n < 0 || n_total < n) return sphi_refuse("n, n_total", -1, SPH_ERROR_COUNT);
    if (n > 0 && !start) return sphi_refuse("start", -1, SPH_ERROR_NULL);
    list.start = start;
    list.index = index;
    return sphi_check_entries(0, n, list, n_total, 1);
}

/* The part of these points: low is the least of x_i along each axis, and reach_low that of x_i - R_i; high
   and reach_high likewise. Along a periodic axis the part begins behind the longest stretch without points,
   and may end beyond the box. radius: R_i of each point, or one for all. Returns 0 or a
   negative sph_error; SPH_ERROR_H as for sph_grid_lists. */
SPH_FN sph_index sph_part_of(int dim, sph_points points, sph_scalars radius, sph_part *part)
{
    const sph_real beyond = SPH_R(1) / SPHI_TINY;
    sph_vec low, high;
    sph_real mean, largest;
    sph_index i;
    int alike, error = sphi_check_points(dim, points);
    if (error) return error;
    if (!part) return sphi_refuse("part", -1, SPH_ERROR_NULL);
    if (points.n > 0) error = sphi_radii(points.n, radius, &mean, &largest, &alike);
    if (!error) error = sphi_check_box(dim, points, SPH_R(0), 0);
    if (error) return error;
    part->low.x = part->low.y = part->low.z = beyond;
    part->high.x = part->high.y = part->high.z = -beyond;
    part->reach_low = part->low;
    part->reach_high = part->high;
    if (points.n == 0) return 0;
    sphi_bounds(dim, points, &low, &high);
    if (sphi_boxed(dim, points.box)) sphi_arcs(dim, points, &low, &high);
    for (i = 0; i < points.n; i++) {
        const sph_real reach = sphi_at(radius, i);
        const sph_vec p = sphi_wrap_point(dim, sphi_point(dim, points, i), low, points.box);
        sph_vec l, h;
        sphi_enclose(p, &part->low, &part->high);
        l.x = p.x - reach;
        l.y = p.y - reach;
        l.z = p.z - reach;
        h.x = p.x + reach;
        h.y = p.y + reach;
        h.z = p.z + reach;
        sphi_enclose(l, &part->reach_low, &part->reach_high);
        sphi_enclose(h, &part->reach_low, &part->reach_high);
    }
    return 0;
}
/* 1 if x, or an image of it, lies between low - reach and high + reach, and by some roundings beyond. */
SPH_FN int sphi_between(sph_real x, sph_real reach, sph_real low, sph_real high, sph_real length)
{
    const sph_real more =
        reach + SPH_R(32) * SPH_EPSILON * (length + reach + SPHI_ABS(x) + SPHI_ABS(low) + SPHI_ABS(high));
    if (length > SPH_R(0)) x = sph_grid_wrap(x, low - more, length); /* the first image that is not below */
    return low <= high && x >= low - more && x <= high + more;
}
SPH_FN int sphi_in_reach(int dim, sph_vec p, sph_real reach, sph_vec low, sph_vec high, sph_vec box)
{
    return sphi_between(p.x, reach, low.x, high.x, box.x) &&
           (dim < 2 || sphi_between(p.y, reach, low.y, high.y, box.y)) &&
           (dim < 3 || sphi_between(p.z, reach, low.z, high.z, box.z));
}
/* Of these points those that may be neighbours of a target of the part: chosen[0 ... *count - 1] are their
   numbers, in ascending order; it has room for points.n. By SPH_GATHER they lie within the reach of the part,
   by SPH_SCATTER the part lies within theirs, and by the others one or the other. radius: of each point, or
   one for all; SPH_GATHER does not read it. The boxes of the part are larger than what it reaches, so that
   some are not needed: sph_list_prune tells which. Returns 0, or a negative sph_error, and then *count
   is 0. */
SPH_FN sph_index sph_select_near(int dim, sph_points points, sph_scalars radius, int criterion, sph_part part,
                                 sph_index *chosen, int64_t *count)
{
    const sph_vec box = points.box;
    sph_real mean, largest;
    sph_index i;
    int alike, error = sphi_check_points(dim, points);
    if (count) *count = 0;
    if (!error && !count) error = sphi_refuse("count", -1, SPH_ERROR_NULL);
    if (!error && (criterion < (int)SPH_GATHER || criterion > (int)SPH_MEAN))
        error = sphi_refuse("criterion", -1, SPH_ERROR_VALUE);
    if (error || points.n == 0) return error;
    if (!chosen) return sphi_refuse("chosen", -1, SPH_ERROR_NULL);
    if (criterion != (int)SPH_GATHER) error = sphi_radii(points.n, radius, &mean, &largest, &alike);
    if (!error) error = sphi_check_box(dim, points, SPH_R(0), 0);
    if (!error && !sphi_part_ok(dim, part)) error = sphi_refuse("part", -1, SPH_ERROR_VALUE);
    if (error) return error;
    for (i = 0; i < points.n; i++) {
        const sph_vec p = sphi_point(dim, points, i);
        if ((criterion != (int)SPH_SCATTER &&
             sphi_in_reach(dim, p, SPH_R(0), part.reach_low, part.reach_high, box)) ||
            (criterion != (int)SPH_GATHER &&
             sphi_in_reach(dim, p, sphi_at(radius, i), part.low, part.high, box)))
            chosen[(*count)++] = i;
    }
    return 0;
}
/* Leaves out the sources that no row names: of n_total sources the first n stay, and of the others those that
   an entry of index names. These get the numbers n, n + 1, ... in the same order, and index is changed to
   them. kept[new] = old for all that stay, of which there are *count; it has room for n_total. start and
   index: rows of n targets. Returns 0, or a negative sph_error, and then *count is 0. */
SPH_FN sph_index sph_list_prune(sph_index n, sph_index n_total, const sph_index *start, sph_index *index,
                                sph_index *kept, int64_t *count)
{
    sph_index j, p, first, last, next = 0;
    int error = sphi_check_part_rows(n, n_total, start, index);
    if (count) *count = 0;
    if (!error && (!count || (!kept && n_total > 0))) error = sphi_refuse("kept, count", -1, SPH_ERROR_NULL);
    if (error) return error;
    first = n > 0 ? start[0] : 0;
    last = n > 0 ? start[n] : 0;
    for (j = 0; j < n_total; j++) kept[j] = j < n;
    for (p = first; p < last; p++) kept[index[p]] = 1;
    for (j = 0; j < n_total; j++) kept[j] = kept[j] ? next++ : -1;
    for (p = first; p < last; p++) index[p] = kept[index[p]];
    for (j = 0; j < n_total; j++) /* in place: a new number is never above the old one */
        if (kept[j] >= 0) kept[kept[j]] = j;
    *count = next;
    return 0;
}
/* Puts each of the rows of n targets (start, index) into the order of the key of its sources, of which there
   are n_total. With keys that belong to the particles (global numbers, of 64 bits) sums have the same
   roundings on any number of machines. A null key stands for the number of the source here. Entries with
   equal keys come in any order. Returns 0 or a negative sph_error. */
SPH_FN sph_index sph_list_sort(sph_index n, sph_index n_total, const sph_index *start, sph_index *index,
                               const int64_t *key)
{
    sph_index i;
    const int error = sphi_check_part_rows(n, n_total, start, index);
    if (error) return error;
    for (i = 0; i < n; i++) sphi_sort(index + start[i], start[i + 1] - start[i], key);
    return 0;
}

/* ================================================================ order, and lists kept for several steps */

/* out[s * stride] = in[permutation[s] * stride] for s = 0 ... n - 1. in and out must not overlap. With
   sph_grid_permutation this puts an array of the caller into the grid's order. */
SPH_FN sph_index sph_permute(sph_index n, const sph_index *permutation, const sph_real *in, size_t stride,
                             sph_real *out)
{
    sph_index s;
    if (n < 0) return sphi_refuse("n", -1, SPH_ERROR_COUNT);
    if (n == 0) return 0;
    if (!permutation || !in || !out) return sphi_refuse("permutation, in, out", -1, SPH_ERROR_NULL);
    if (stride < 1) return sphi_refuse("stride", -1, SPH_ERROR_COUNT);
    for (s = 0; s < n && SPH_CHECK; s++)
        if (permutation[s] < 0 || permutation[s] >= n) return sphi_refuse("permutation", s, SPH_ERROR_LIST);
    for (s = 0; s < n; s++) out[(size_t)s * stride] = in[(size_t)permutation[s] * stride];
    return 0;
}

/* inverse[permutation[s]] = s: where each particle has gone. */
SPH_FN sph_index sph_permute_inverse(sph_index n, const sph_index *permutation, sph_index *inverse)
{
    sph_index s;
    if (n < 0) return sphi_refuse("n", -1, SPH_ERROR_COUNT);
    if (n == 0) return 0;
    if (!permutation || !inverse) return sphi_refuse("permutation, inverse", -1, SPH_ERROR_NULL);
    for (s = 0; s < n && SPH_CHECK; s++)
        if (permutation[s] < 0 || permutation[s] >= n) return sphi_refuse("permutation", s, SPH_ERROR_LIST);
    for (s = 0; s < n; s++) inverse[permutation[s]] = s;
    return 0;
}

/* Whether |v| > length. It also works for lengths whose squares overflow or underflow. */
SPH_FN int sphi_longer(int dim, sph_vec v, sph_real length)
{
    const sph_real x = SPHI_ABS(v.x), y = dim > 1 ? SPHI_ABS(v.y) : SPH_R(0),
                   z = dim > 2 ? SPHI_ABS(v.z) : SPH_R(0);
    const sph_real xy = x > y ? x : y, most = xy > z ? xy : z;
    if (!(most <= length)) return 1;
    if (most == SPH_R(0)) return 0;
    v.x = x / most;
    v.y = y / most;
    v.z = z / most;
    length /= most; /* length and |v| are not below 1 now */
    return sph_dot(dim, v, v) > length * length;
}

/* 1 if a particle has moved by more than skin / 2 from its position `then` (by the minimum image, if now.box
   is set), else 0 or a negative sph_error. As long as it is 0, lists that were built at the positions `then`
   with the radius + skin still hold all pairs within the radius. */
SPH_FN int sph_rebuild_due(int dim, sph_points now, sph_points then, sph_real skin)
{
    int error = sphi_check_points(dim, now);
    sph_index i;
    if (!error) error = sphi_check_points(dim, then);
    if (error) return error;
    if (now.n != then.n) return sphi_refuse("then.n", -1, SPH_ERROR_COUNT);
    if (!sphi_finite(skin) || skin < SPH_R(0)) return sphi_refuse("skin", -1, SPH_ERROR_VALUE);
    then.box = now.box;
    if (sphi_check_box(dim, now, SPH_R(0), 0) || sphi_check_box(dim, then, SPH_R(0), 0)) return SPH_ERROR_BOX;
    for (i = 0; i < now.n; i++) {
        const sph_vec moved = sphi_separation(dim, now, sphi_point(dim, now, i), sphi_point(dim, then, i));
        if (sphi_longer(dim, moved, SPH_R(0.5) * skin)) return 1;
    }
    return 0;
}

SPHI_END
#endif /* !SPH_OPENCL */

#endif /* SPH_H */

/* The options are still those of the first inclusion: as at the end of sph_kernels.h. */
#if !SPH_OPENCL
/* clang-format off */
#ifdef __GNUC__
#  pragma GCC diagnostic push
#  pragma GCC diagnostic ignored "-Wredundant-decls"
#endif
#ifdef __cplusplus
extern "C" {
#endif
char (*sphi_SPH_OPENMP_must_not_change_between_inclusions(void))[1 + SPH_OPENMP];
char (*sphi_SPH_AVX512_must_not_change_between_inclusions(void))[1 + SPH_AVX512];
char (*sphi_SPH_AVX2_must_not_change_between_inclusions(void))[1 + SPH_AVX2];
#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#  pragma GCC diagnostic pop
#endif
/* clang-format on */
#endif

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
