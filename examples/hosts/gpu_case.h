/* SPDX-License-Identifier: MIT
 *
 * gpu_case.h - what the OpenCL and the CUDA host share: a disordered cloud with its neighbour lists, found on
 * the host; what the host computes from it; and the comparison.
 */
#ifndef GPU_CASE_H
#define GPU_CASE_H

#include "known.h"
#include "sph.h"

#include <stdlib.h>

enum { CASE_SIDE = 24, CASE_N = CASE_SIDE * CASE_SIDE * CASE_SIDE, CASE_PER_PARTICLE = 80 };
#define CASE_KERNEL SPH_WENDLAND_C2
#define CASE_DIM 3

typedef struct gpu_case {
    /* what goes to the device */
    sph_real h, x[CASE_N], y[CASE_N], z[CASE_N], m[CASE_N], V[CASE_N], mobility[CASE_N], u[CASE_N];
    sph_index start[CASE_N + 1], index[CASE_PER_PARTICLE * CASE_N];
    sph_real rho[CASE_N], laplacian[CASE_N];               /* by the host */
    sph_real rho_device[CASE_N], laplacian_device[CASE_N]; /* what comes back */
    known_row known[KNOWN_MAX];
    int rows;
    sph_real w[KNOWN_MAX], f[KNOWN_MAX]; /* of the known rows: what comes back */
} gpu_case;

/* The cloud, its lists and the host's answers. Returns 0 if all is there. */
static inline int case_make(gpu_case *c, const char *known)
{
    const double dx = 1.0 / CASE_SIDE;
    const size_t size = sph_grid_workspace(CASE_DIM, CASE_N);
    const sph_points x = sph_points_separate(CASE_N, c->x, c->y, c->z);
    const sph_list list = {c->start, c->index};
    const sph_scalars mobility = sph_scalars_array(c->mobility), u = sph_scalars_array(c->u);
    const sph_scalar_out rho = sph_scalar_out_array(c->rho, 0);
    const sph_scalar_out laplacian = sph_scalar_out_array(c->laplacian, 0);
    const sph_elliptic_options options = {0};
    sph_cloud cloud = sph_cloud_of(x, list, sph_scalars_same(&c->h), sph_scalars_array(c->V));
    sph_real radius;
    sph_query query;
    sph_grid grid;
    int64_t pairs;
    int i, error;
    void *const work = malloc(size);
    if (!work) return 1;
    c->h = SPH_R(1.2 * dx);
    for (i = 0; i < CASE_N; i++) {
        c->x[i] = SPH_R(dx * (i % CASE_SIDE + 0.5 + 0.2 * sin(37.0 * i)));
        c->y[i] = SPH_R(dx * (i / CASE_SIDE % CASE_SIDE + 0.5 + 0.2 * cos(53.0 * i)));
        c->z[i] = SPH_R(dx * (i / CASE_SIDE / CASE_SIDE + 0.5 + 0.2 * sin(71.0 * i)));
        c->V[i] = SPH_R(dx * dx * dx);
        c->m[i] = SPH_R(1.5) * c->V[i];
        c->mobility[i] = SPH_R(1) + c->x[i];
        c->u[i] = c->x[i] * c->x[i] + SPH_R(2) * c->y[i] * c->z[i];
    }
    radius = c->h * sph_kernel_support_ratio(CASE_KERNEL);
    query = sph_query_of(x, SPH_GATHER, sph_scalars_same(&radius), 0);
    error = (int)sph_grid_build(CASE_DIM, x, query.radius, work, size, &grid);
    if (!error)
        error = (int)sph_grid_lists(CASE_DIM, &grid, query, c->start, c->index, CASE_PER_PARTICLE * CASE_N,
                                    &pairs);
    free(work);
    if (error) return error;
    cloud = sph_cloud_checked(CASE_DIM, cloud); /* once, for both sweeps */
    error = (int)sph_density_summation(CASE_KERNEL, CASE_DIM, cloud, sph_scalars_array(c->m), rho);
    if (!error) error = (int)sph_elliptic_msph(CASE_KERNEL, CASE_DIM, cloud, mobility, options, u, laplacian);
    if (error) return error;
    c->rows = known_read(known, c->known);
    return c->rows == 0;
}

/* the largest difference, relative to the largest value; a NaN is infinitely far */
static inline double case_difference(const sph_real *a, const sph_real *b)
{
    double off = 0, largest = 0;
    int i;
    for (i = 0; i < CASE_N; i++) {
        const double d = fabs((double)a[i] - (double)b[i]);
        if (!(d < HUGE_VAL)) return HUGE_VAL;
        if (d > off) off = d;
        largest = known_larger(largest, (double)b[i]);
    }
    return largest > 0 ? off / largest : HUGE_VAL;
}
/* Prints how far the device is from the host; returns the number of failures. */
static inline int case_compare(const gpu_case *c, const char *device)
{
    const double tolerance = 1000 * (double)SPH_EPSILON, rho = case_difference(c->rho_device, c->rho);
    const double laplacian = case_difference(c->laplacian_device, c->laplacian);
    const int bad = known_compare(c->rows, c->known, c->w, c->f, 16 * (double)SPH_EPSILON);
    const int middle = (CASE_SIDE / 2 * CASE_SIDE + CASE_SIDE / 2) * CASE_SIDE + CASE_SIDE / 2;
    const double rho_middle = (double)c->rho_device[middle];
    const double laplacian_middle = (double)c->laplacian_device[middle];
    printf("%s, %s\n", device, SPH_SINGLE ? "float" : "double");
    printf("  known answers: %d rows, %d off\n", c->rows, bad);
    printf("  density          %12.6f in the middle, at most %.1e from the host's\n", rho_middle, rho);
    printf("  div(m grad u)    %12.6f in the middle, at most %.1e from the host's\n", laplacian_middle,
           laplacian);
    if (bad || !(rho <= tolerance) || !(laplacian <= tolerance)) printf("  WRONG\n");
    return bad + !(rho <= tolerance) + !(laplacian <= tolerance);
}

#endif
