/* SPDX-License-Identifier: MIT
 *
 * elliptic.h - the setting of the paper on the elliptic operator (Lukyanov & Vuik 2020, arXiv:1711.11351), shared by its drivers: clouds of particles, their
 * neighbour lists, the four schemes with the four gradients of the kernel, the data files of the figures.
 *
 *     cloud c = {0};
 *     cloud_lattice(&c, 2, 21, 2.0, 0.05);          particles, volumes, m = 1
 *     cloud_neighbours(&c, 1.2 * c.dx);             h and lists; again after the particles were moved
 *     ... fill c.u (and c.m)
 *     cloud_apply(&c, SCHEME_M, (sph_elliptic_options){0});   div(m grad u) in c.value, or
 *     cloud_rows(&c, SCHEME_M, (sph_elliptic_options){0});    its rows in c.row, c.diagonal
 *     cloud_close(&c);
 */
#ifndef ELLIPTIC_H
#define ELLIPTIC_H

#if defined(__clang__)
#pragma clang diagnostic ignored \
    "-Wpass-failed" /* the gradient is chosen at run time here: some loops then do not vectorise */
#endif

#include <math.h>

#include "../common/figure.h"
#include "../common/host.h"
#include "../common/random.h"
#include "../common/report.h"

#define ELLIPTIC_KERNEL SPH_CUBIC_SPLINE /* (12) */

/* Brookshaw (27), corrected Brookshaw (51), Schwaiger (52), the paper's own (69) */
enum { SCHEME_B, SCHEME_CB, SCHEME_S, SCHEME_M, SCHEMES };
static const char *const elliptic_scheme_name[SCHEMES] = {"B", "CB", "S", "M"};

/* the gradients of the kernel, in the order of sph_elliptic_gradient */
enum { GRADIENTS = 4 };
static const char *const elliptic_gradient_name[GRADIENTS] = {"(15)", "(16)", "(17)", "(18)"};

static inline sph_elliptic_options elliptic_with_gradient(int gradient)
{
    sph_elliptic_options o = {0};
    o.gradient = gradient;
    return o;
}

/* Particles with one h for all, and their neighbours. All zeros is an empty cloud. */
typedef struct cloud {
    int dim, n;
    double dx, h;
    double jitter;          /* largest displacement from the lattice along an axis */
    double low[3], high[3]; /* the faces of the domain: particles on them are boundary particles */
    double *x, *y, *z;      /* those beyond dim are 0 */
    double *depth;          /* distance from the boundary of the domain */
    double *V, *m, *u, *value, *diagonal; /* m = 1 until it is set */
    unsigned char *status;
    search_grid grid;
    search_lists lists;
    double *row; /* as long as lists.index */
    int capacity;
    int64_t row_capacity;
} cloud;

/* Room for n particles; what they were is lost. */
static inline void cloud_size(cloud *c, int dim, int n)
{
    double **const arrays[] = {&c->x, &c->y, &c->z, &c->depth, &c->V, &c->m, &c->u, &c->value, &c->diagonal};
    size_t a;
    int i;
    if (n > c->capacity) {
        for (a = 0; a < sizeof arrays / sizeof *arrays; a++)
            *arrays[a] = (double *)need(*arrays[a], (size_t)n, sizeof(double));
        c->status = (unsigned char *)need(c->status, (size_t)n, 1);
        c->capacity = n;
    }
    c->dim = dim;
    c->n = n;
    c->jitter = 0;
    for (i = 0; i < n; i++) {
        c->x[i] = c->y[i] = c->z[i] = c->u[i] = 0;
        c->m[i] = 1;
    }
}

static inline void cloud_close(cloud *c)
{
    void *const arrays[] = {c->x, c->y,   c->z,     c->depth,    c->V,     c->m,
                            c->u, c->row, c->value, c->diagonal, c->status};
    size_t a;
    for (a = 0; a < sizeof arrays / sizeof *arrays; a++) free(arrays[a]);
    search_grid_close(&c->grid);
    search_lists_close(&c->lists);
}

static inline sph_points cloud_points(const cloud *c) { return sph_points_separate(c->n, c->x, c->y, c->z); }
static inline sph_cloud cloud_all(const cloud *c)
{
    return sph_cloud_of(cloud_points(c), search_list(&c->lists), sph_scalars_same(&c->h),
                        sph_scalars_array(c->V));
}
/* axis 0, 1, 2 */
static inline double *cloud_axis(const cloud *c, int axis)
{
    return axis == 0 ? c->x : axis == 1 ? c->y : c->z;
}

static inline void cloud_depths(cloud *c)
{
    int i, a;
    for (i = 0; i < c->n; i++) {
        c->depth[i] = HUGE_VAL;
        for (a = 0; a < c->dim; a++)
            c->depth[i] =
                fmin(c->depth[i], fmin(cloud_axis(c, a)[i] - c->low[a], c->high[a] - cloud_axis(c, a)[i]));
    }
}

/* side^dim particles in the nodes low + i dx, boundary included, V = dx^dim; particle (i, j, k) is i + side (j + side k). */
static inline void cloud_lattice(cloud *c, int dim, int side, double low, double dx)
{
    const int n = dim == 1 ? side : dim == 2 ? side * side : side * side * side;
    int i, a;
    cloud_size(c, dim, n);
    c->dx = dx;
    for (i = 0; i < n; i++) {
        const int at[3] = {i % side, i / side % side, i / side / side};
        for (a = 0; a < dim; a++) cloud_axis(c, a)[i] = low + at[a] * dx;
        c->V[i] = pow(dx, dim);
    }
    for (a = 0; a < 3; a++) {
        c->low[a] = low;
        c->high[a] = low + (side - 1) * dx;
    }
    cloud_depths(c);
}

/* Section 5's layout of the unit square: N x N particles in the middle of cells, then 4 N boundary particles in the middle of the outer faces of cells, in the order y = 0, x = 1, y = 1, x = 0.
   All have the volume dx^2. */
static inline void cloud_cells(cloud *c, int N)
{
    const double dx = 1.0 / N;
    int i;
    cloud_size(c, 2, N * N + 4 * N);
    c->dx = dx;
    for (i = 0; i < c->n; i++) c->V[i] = dx * dx;
    for (i = 0; i < N * N; i++) {
        c->x[i] = (i % N + 0.5) * dx;
        c->y[i] = (i / N + 0.5) * dx;
    }
    for (i = 0; i < N; i++) {
        const int y0 = N * N + i, x1 = y0 + N, y1 = x1 + N, x0 = y1 + N;
        c->x[y0] = c->y[x1] = c->x[y1] = c->y[x0] = (i + 0.5) * dx;
        c->y[y0] = c->x[x0] = 0;
        c->x[x1] = c->y[y1] = 1;
    }
    for (i = 0; i < 3; i++) {
        c->low[i] = 0;
        c->high[i] = 1;
    }
    cloud_depths(c);
}

/* Moves each particle that is not on the boundary by up to amplitude dx along each axis. */
static inline void cloud_perturb(cloud *c, double amplitude, pcg32 *g)
{
    int i, a;
    for (i = 0; i < c->n; i++)
        if (c->depth[i] > 1e-9 * c->dx)
            for (a = 0; a < c->dim; a++)
                cloud_axis(c, a)[i] += amplitude * c->dx * (2 * pcg32_uniform(g) - 1);
    c->jitter = amplitude * c->dx;
    cloud_depths(c);
}

/* Is the support of particle i full? One more layer of a lattice would lie beyond its reach. */
static inline int cloud_inside(const cloud *c, int i)
{
    const double reach = c->h * sph_kernel_support_ratio(ELLIPTIC_KERNEL);
    return c->depth[i] + c->dx - c->jitter >= reach * (1 - 1e-9);
}

/* Room for a number for each entry of the lists. */
static inline void cloud_row_size(cloud *c)
{
    if (c->lists.capacity <= c->row_capacity) return;
    c->row = (double *)need(c->row, (size_t)c->lists.capacity, sizeof *c->row);
    c->row_capacity = c->lists.capacity;
}
/* Lists by a criterion; no radius exceeds `widest`. */
static inline void cloud_search(cloud *c, sph_points x, int criterion, sph_scalars radius, double widest)
{
    search_grid_build(&c->grid, c->dim, x, widest);
    search_lists_find(&c->lists, c->dim, &c->grid, sph_query_of(x, criterion, radius, SPH_LIST_SORTED));
    cloud_row_size(c);
}
/* Neighbours for the smoothing length h. */
static inline void cloud_neighbours(cloud *c, double h)
{
    const double radius = h * sph_kernel_support_ratio(ELLIPTIC_KERNEL);
    c->h = h;
    cloud_search(c, cloud_points(c), SPH_GATHER, sph_scalars_same(&radius), radius);
}

#ifndef ELLIPTIC_DIM
#define ELLIPTIC_DIM(c) ((c)->dim) /* a driver whose clouds are all of one dimension compiles that one alone */
#endif
/* div(m grad u) as rows, or of c->u into c->value. Both return how many particles are not ok (c->status
   tells). */
static inline int cloud_rows(cloud *c, int scheme, sph_elliptic_options o)
{
    const sph_cloud all = cloud_all(c);
    const sph_scalars m = sph_scalars_array(c->m);
    const sph_rows_out out = {.row = c->row, .diagonal = c->diagonal, .status = c->status};
    sph_index bad;
#define CLOUD_ROWS(sweep) WITH_DIM_1_2_3(sweep, ELLIPTIC_KERNEL, ELLIPTIC_DIM(c), all, m, o, out)
    if (scheme == SCHEME_B) bad = CLOUD_ROWS(sph_elliptic_rows_brookshaw);
    else if (scheme == SCHEME_CB) bad = CLOUD_ROWS(sph_elliptic_rows_brookshaw_corrected);
    else if (scheme == SCHEME_S) bad = CLOUD_ROWS(sph_elliptic_rows_schwaiger);
    else bad = CLOUD_ROWS(sph_elliptic_rows_msph);
#undef CLOUD_ROWS
    return (int)expect(bad);
}
static inline int cloud_apply(cloud *c, int scheme, sph_elliptic_options o)
{
    const sph_cloud all = cloud_all(c);
    const sph_scalars m = sph_scalars_array(c->m), u = sph_scalars_array(c->u);
    const sph_scalar_out out = sph_scalar_out_array(c->value, c->status);
    sph_index bad;
#define CLOUD_APPLY(sweep) WITH_DIM_1_2_3(sweep, ELLIPTIC_KERNEL, ELLIPTIC_DIM(c), all, m, o, u, out)
    if (scheme == SCHEME_B) bad = CLOUD_APPLY(sph_elliptic_brookshaw);
    else if (scheme == SCHEME_CB) bad = CLOUD_APPLY(sph_elliptic_brookshaw_corrected);
    else if (scheme == SCHEME_S) bad = CLOUD_APPLY(sph_elliptic_schwaiger);
    else bad = CLOUD_APPLY(sph_elliptic_msph);
#undef CLOUD_APPLY
    return (int)expect(bad);
}

/* A value that the paper shows in an image, or not at all, against the one that this toolkit had when it was checked against an independent implementation. */
static inline void elliptic_regression(report *r, const char *item, const char *at, const char *quantity,
                                       double known, double measured)
{
    report_absolute(report_beside(r, REPORT_REGRESSION), item, at, quantity, known, measured, 1e-6 * fmax(fabs(known), 1e-4));
}

#endif
