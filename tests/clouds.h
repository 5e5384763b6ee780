/* SPDX-License-Identifier: MIT */
/*
 * clouds.h - particles, neighbour lists and test fields that the tests of the operators share.
 *
 *     cloud c = cloud_lattice(2, 11, 2.0, 0.25, 1);      11 x 11 particles on the unit square, h = 2 dx, jittered by up to dx / 4
 *     cloud_set(&c, field_smooth);                       c.f
 *     ... cloud_view(&c), cloud_f(&c) ...              its parts: cloud_points, cloud_list, cloud_h, cloud_V
 *     cloud_free(&c);
 *
 * Include it after sph.h. Memory is checked by abort: a test that has none has nothing to say.
 */
#ifndef CLOUDS_H
#define CLOUDS_H

#include "../examples/common/random.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

/* A tolerance in double, and in float. */
#define BY_PRECISION(in_double, in_float) (SPH_SINGLE ? (in_float) : (in_double))

static inline void *cloud_memory(size_t count, size_t size)
{
    void *const p = calloc(count ? count : 1, size);
    if (!p) abort();
    return p;
}

/* ---- fields. d, if not null, gets the derivatives in the order x, y, z, xx, xy, yy, xz, yz, zz: that of the derivatives of a cloud in tests, too ---- */

enum { COMPONENTS = 9 };
typedef double field_fn(const double *p, double *d);

static inline int field_hessian_components(int dim) { return dim * (dim + 1) / 2; }

/* in 2D, where z = 0, this is sin(2.3 x + 1.7 y + .2) + .4 x^3 + .5 e^y */
static inline double field_smooth(const double *p, double *d)
{
    const double x = p[0], y = p[1], z = p[2], a = 2.3, b = 1.7, c = -1.3, s = sin(a * x + b * y + c * z + 0.2), k = cos(a * x + b * y + c * z + 0.2);
    if (d) {
        d[0] = a * k + 1.2 * x * x + 0.6 * z * z;
        d[1] = b * k + 0.5 * exp(y);
        d[2] = c * k + 1.2 * x * z;
        d[3] = -a * a * s + 2.4 * x;
        d[4] = -a * b * s;
        d[5] = -b * b * s + 0.5 * exp(y);
        d[6] = -a * c * s + 1.2 * z;
        d[7] = -b * c * s;
        d[8] = -c * c * s + 1.2 * x;
    }
    return s + 0.4 * x * x * x + 0.5 * exp(y) + 0.6 * x * z * z;
}

/* the field of the ICSPM paper; 1D */
static inline double field_paper(const double *p, double *d)
{
    const double x = p[0];
    if (d) {
        int c;
        for (c = 0; c < COMPONENTS; c++) d[c] = 0.0;
        d[0] = 2.0 * x - PI * sin(PI * x);
        d[3] = 2.0 - PI * PI * cos(PI * x);
    }
    return x * x + cos(PI * x);
}

static inline double field_constant(const double *p, double *d)
{
    int c;
    (void)p;
    if (d)
        for (c = 0; c < COMPONENTS; c++) d[c] = 0.0;
    return 1.7;
}

static inline double field_linear(const double *p, double *d)
{
    if (d) {
        int c;
        for (c = 0; c < COMPONENTS; c++) d[c] = 0.0;
        d[0] = 1.3;
        d[1] = -0.8;
        d[2] = 0.6;
    }
    return 0.7 + 1.3 * p[0] - 0.8 * p[1] + 0.6 * p[2];
}

/* every derivative has a value of its own, so that no two components can be mistaken */
static inline double field_quadratic(const double *p, double *d)
{
    const double x = p[0], y = p[1], z = p[2];
    if (d) {
        d[0] = 1.3 + 2.2 * x + 0.9 * y - 0.5 * z;
        d[1] = -0.8 + 0.9 * x - 1.4 * y + 0.7 * z;
        d[2] = 0.6 - 0.5 * x + 0.7 * y + 3.2 * z;
        d[3] = 2.2;
        d[4] = 0.9;
        d[5] = -1.4;
        d[6] = -0.5;
        d[7] = 0.7;
        d[8] = 3.2;
    }
    return 0.7 + 1.3 * x - 0.8 * y + 0.6 * z + 1.1 * x * x + 0.9 * x * y - 0.7 * y * y - 0.5 * x * z + 0.7 * y * z + 1.6 * z * z;
}

/* ---- clouds ---- */

typedef struct cloud {
    int dim;
    sph_index n;
    int side; /* lattices: particles per edge; particle i is (i % side, i / side % side, i / side^2) */
    double dx;
    sph_real h, *x, *y, *z, *V, *f;
    sph_index *start, *index;
    int64_t pairs;
} cloud;

static inline cloud cloud_new(int dim, sph_index n)
{
    cloud c;
    c.dim = dim;
    c.n = n;
    c.side = 0;
    c.dx = 0.0;
    c.h = SPH_R(1);
    c.x = (sph_real *)cloud_memory((size_t)n, sizeof *c.x);
    c.y = (sph_real *)cloud_memory((size_t)n, sizeof *c.y);
    c.z = (sph_real *)cloud_memory((size_t)n, sizeof *c.z);
    c.V = (sph_real *)cloud_memory((size_t)n, sizeof *c.V);
    c.f = (sph_real *)cloud_memory((size_t)n, sizeof *c.f);
    c.start = (sph_index *)cloud_memory((size_t)n + 1, sizeof *c.start);
    c.index = 0;
    c.pairs = 0;
    return c;
}

static inline void cloud_free(cloud *c)
{
    free(c->x);
    free(c->y);
    free(c->z);
    free(c->V);
    free(c->f);
    free(c->start);
    free(c->index);
}

static inline sph_points cloud_points(const cloud *c) { return sph_points_separate(c->n, c->x, c->y, c->z); }
static inline sph_scalars cloud_h(const cloud *c) { return sph_scalars_same(&c->h); }
static inline sph_scalars cloud_V(const cloud *c) { return sph_scalars_array(c->V); }
static inline sph_scalars cloud_f(const cloud *c) { return sph_scalars_array(c->f); }
static inline sph_list cloud_list(const cloud *c)
{
    sph_list l;
    l.start = c->start;
    l.index = c->index;
    return l;
}
static inline sph_cloud cloud_view(const cloud *c) { return sph_cloud_of(cloud_points(c), cloud_list(c), cloud_h(c), cloud_V(c)); }
/* Where derivatives go: arrays for gx, gy, gz, hxx, hxy, hyy, hxz, hyz, hzz, Laplacian and conditioning. */
static inline sph_derivatives_out cloud_derivatives_out(sph_real *const *out, unsigned char *status)
{
    sph_derivatives_out o;
    o.gx = out[0];
    o.gy = out[1];
    o.gz = out[2];
    o.hxx = out[3];
    o.hxy = out[4];
    o.hyy = out[5];
    o.hxz = out[6];
    o.hyz = out[7];
    o.hzz = out[8];
    o.laplacian = out[9];
    o.conditioning = out[10];
    o.stride = 1;
    o.status = status;
    return o;
}
static inline void cloud_position(const cloud *c, sph_index i, double *p)
{
    p[0] = (double)c->x[i];
    p[1] = c->dim > 1 ? (double)c->y[i] : 0.0;
    p[2] = c->dim > 2 ? (double)c->z[i] : 0.0;
}

static inline void cloud_set(cloud *c, field_fn *f)
{
    sph_index i;
    for (i = 0; i < c->n; i++) {
        double p[3];
        cloud_position(c, i, p);
        c->f[i] = SPH_R(f(p, 0));
    }
}

/* The lists by a criterion, for these radii. Returns the first answer that is not 0. */
static inline sph_index cloud_search(cloud *c, int criterion, sph_scalars radius)
{
    const size_t size = sph_grid_workspace(c->dim, c->n);
    const sph_query query = sph_query_of(cloud_points(c), criterion, radius, 0);
    void *const work = cloud_memory(size, 1);
    sph_grid g;
    sph_index answer = sph_grid_build(c->dim, cloud_points(c), radius, work, size, &g);
    free(c->index);
    c->index = 0;
    if (answer == 0) answer = sph_grid_count(c->dim, &g, query, c->start, &c->pairs);
    if (answer == 0) {
        c->index = (sph_index *)cloud_memory((size_t)c->pairs, sizeof *c->index);
        answer = sph_grid_lists(c->dim, &g, query, c->start, c->index, c->pairs, &c->pairs);
    }
    free(work);
    return answer;
}
/* The radius is a little longer than the support: entries beyond it do no harm, and operators must not mind. */
static inline void cloud_neighbors(cloud *c, double radius)
{
    const sph_real reach = SPH_R(radius);
    if (cloud_search(c, SPH_GATHER, sph_scalars_same(&reach)) != 0) abort();
}

static inline double cloud_symmetric(pcg32 *g) { return 2.0 * pcg32_uniform(g) - 1.0; }

/* how many of its coordinates lie on the boundary of the unit box */
static inline int cloud_walls(const cloud *c, sph_index i)
{
    double p[3];
    int a, walls = 0;
    cloud_position(c, i, p);
    for (a = 0; a < c->dim; a++) walls += p[a] <= 0.0 || p[a] >= 1.0;
    return walls;
}

/* The unit interval, square or cube, particles on the boundary included, with half a volume on faces, a quarter on edges, an eighth at corners (in 3D).
   Jittered by up to jitter * dx in each coordinate; boundary particles slide along their wall. h = h_over_dx * dx. Kernels of support 2. */
static inline cloud cloud_lattice(int dim, int side, double h_over_dx, double jitter, uint64_t seed)
{
    const double dx = 1.0 / (side - 1);
    cloud c = cloud_new(dim, (sph_index)(dim == 1 ? side : dim == 2 ? side * side : side * side * side));
    pcg32 g;
    sph_index i;
    pcg32_seed(&g, seed, 7);
    c.side = side;
    c.dx = dx;
    c.h = SPH_R(h_over_dx * dx);
    for (i = 0; i < c.n; i++) {
        const int cell[3] = {(int)i % side, (int)i / side % side, (int)i / side / side};
        sph_real *const coordinate[3] = {c.x, c.y, c.z};
        double V = 1.0;
        int a;
        for (a = 0; a < dim; a++) {
            const int wall = cell[a] == 0 || cell[a] == side - 1;
            const double shift = cloud_symmetric(&g) * jitter * dx;
            coordinate[a][i] = SPH_R((double)cell[a] / (side - 1) + (wall ? 0.0 : shift));
            V *= wall ? 0.5 * dx : dx;
        }
        c.V[i] = SPH_R(V);
    }
    cloud_neighbors(&c, 2.05 * h_over_dx * dx);
    return c;
}

/* Random positions on [0, 1], the first at 0, the last at 1, ascending; volumes by midpoints, the ends half the interval; h = factor * largest volume. */
static inline cloud cloud_random_1d(int n, double factor, uint64_t seed)
{
    cloud c = cloud_new(1, (sph_index)n);
    double *const x = (double *)cloud_memory((size_t)n, sizeof *x), largest = 0.0;
    pcg32 g;
    int i, j;
    pcg32_seed(&g, seed, 11);
    x[0] = 0.0;
    for (i = 1; i < n - 1; i++) { /* insertion sort */
        const double new_x = pcg32_uniform(&g);
        for (j = i; j > 0 && x[j - 1] > new_x; j--) x[j] = x[j - 1];
        x[j] = new_x;
    }
    x[n - 1] = 1.0;
    for (i = 0; i < n; i++) {
        const double left = i > 0 ? 0.5 * (x[i - 1] + x[i]) : 0.0, right = i < n - 1 ? 0.5 * (x[i] + x[i + 1]) : 1.0;
        c.x[i] = SPH_R(x[i]);
        c.V[i] = SPH_R(right - left);
        if (right - left > largest) largest = right - left;
    }
    free(x);
    c.side = n;
    c.dx = 1.0 / (n - 1);
    c.h = SPH_R(factor * largest);
    cloud_neighbors(&c, 2.05 * factor * largest);
    return c;
}

/* positive, within a factor of 19 of each other: nothing that exactness may depend on */
static inline void cloud_random_volumes(cloud *c, uint64_t seed)
{
    pcg32 g;
    sph_index i;
    pcg32_seed(&g, seed, 13);
    for (i = 0; i < c->n; i++) c->V[i] = SPH_R((1.0 + 0.9 * cloud_symmetric(&g)) * pow(c->dx, c->dim));
}

#endif
