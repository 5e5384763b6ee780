/* SPDX-License-Identifier: MIT */
/* sph_shim.c - see sph_shim.h. */
#include <stddef.h>
#include <stdint.h>

#if defined(_MSC_VER)
#define SHIM_THREAD __declspec(thread)
#elif defined(__GNUC__)
#define SHIM_THREAD __thread
#else
#define SHIM_THREAD
#endif
/* what this thread was last refused */
static SHIM_THREAD const char *refused_argument;
static SHIM_THREAD int64_t refused_particle;
static SHIM_THREAD int refused_error;
#define SPH_REFUSED(argument, particle, error) \
    (refused_argument = (argument), refused_particle = (particle), refused_error = (error))
#include "sph_shim.h"

struct sph_shim_cloud {
    int kernel, dim;
    sph_cloud cloud;
};

/* The one switch around a sweep: SWEEP(K, D) with kernel and dimension as constants, which fold, for these
   kernels; the others share one copy that asks at each pair (and takes twice as long).
   -DSHIM_SWITCH_KERNEL=SPH_SWITCH_KERNEL makes a copy for every kernel, at the cost of minutes of compile
   time; better put your own here. */
/* clang-format off */
#ifndef SHIM_SWITCH_KERNEL
#define SHIM_SWITCH_KERNEL(k, CALL) \
    switch (k) { \
    case SPH_CUBIC_SPLINE: CALL(SPH_CUBIC_SPLINE) break; \
    case SPH_WENDLAND_C2: CALL(SPH_WENDLAND_C2) break; \
    default: CALL((sph_kernel)(k)) break; \
    }
#endif
/* clang-format on */
#define EVERY_DIM(K) answer = c->dim == 1 ? SWEEP(K, 1) : c->dim == 2 ? SWEEP(K, 2) : SWEEP(K, 3);

int sph_shim_version(void) { return SPH_VERSION; }
int sph_shim_real_size(void) { return (int)sizeof(sph_real); }
int sph_shim_index_size(void) { return (int)sizeof(sph_index); }
int sph_shim_kernel_from_name(const char *name) { return sph_kernel_from_name(name); }
const char *sph_shim_status_text(int status) { return sph_status_text(status); }
const char *sph_shim_refused(int error, sph_index *particle)
{
    const char *const argument = refused_error == error && refused_argument ? refused_argument : "";
    if (particle) *particle = *argument ? (sph_index)refused_particle : -1;
    refused_error = 0;
    return argument;
}
sph_real sph_shim_kernel_support(int kernel) { return sph_kernel_support_ratio((sph_kernel)kernel); }

SPH_FN int kernel_wf(sph_kernel k, int dim, sph_index n, const sph_real *r, sph_real h, sph_real *w,
                     sph_real *f)
{
    sph_index i;
    for (i = 0; i < n; i++) {
        const sph_wf v = sph_kernel_wf(k, dim, r[i], h);
        if (w) w[i] = v.w;
        if (f) f[i] = v.f;
    }
    return 0;
}
int sph_shim_kernel_wf(int kernel, int dim, sph_index n, const sph_real *r, sph_real h, sph_real *w,
                       sph_real *f)
{
    int answer = SPH_ERROR_KERNEL;
    if (dim < 1 || dim > 3) return SPH_ERROR_DIM;
    if (!r && n > 0) return SPH_ERROR_NULL;
    if (!(h > SPH_R(0))) return SPH_ERROR_H;
#define ANY_DIM(K) answer = kernel_wf(K, dim, n, r, h, w, f);
    SPH_SWITCH_KERNEL((sph_kernel)kernel, ANY_DIM)
    return answer;
}

/* ---------------------------------------------------------------- clouds */

size_t sph_shim_cloud_size(void) { return sizeof(sph_shim_cloud); }
int sph_shim_cloud_init(sph_shim_cloud *c, int kernel, int dim, sph_index n, const sph_real *x,
                        const sph_real *y, const sph_real *z, size_t stride)
{
    const sph_points points = sph_points_strided(n, x, y, z, stride);
    const sph_list none = {0, 0};
    if (dim < 1 || dim > 3) return SPH_ERROR_DIM;
    if (!c || (n != 0 && (!x || (dim > 1 && !y) || (dim > 2 && !z)))) return SPH_ERROR_NULL;
    if (kernel < 0 || kernel >= (int)SPH_KERNEL_COUNT) return SPH_ERROR_KERNEL;
    c->kernel = kernel;
    c->dim = dim;
    c->cloud = sph_cloud_of(points, none, sph_scalars_none(), sph_scalars_none());
    return 0;
}
/* what changes a cloud takes the mark of sph_shim_cloud_check from it, but for a range within the old one */
void sph_shim_cloud_volumes(sph_shim_cloud *c, const sph_real *h, size_t h_stride, const sph_real *V,
                            size_t V_stride)
{
    c->cloud.h = sph_scalars_strided(h, h_stride);
    c->cloud.volume = sph_scalars_strided(V, V_stride);
    c->cloud.checked = 0;
}
void sph_shim_cloud_lists(sph_shim_cloud *c, const sph_index *start, const sph_index *index)
{
    c->cloud.list.start = start;
    c->cloud.list.index = index;
    c->cloud.checked = 0;
}
void sph_shim_cloud_periodic(sph_shim_cloud *c, sph_real lx, sph_real ly, sph_real lz)
{
    c->cloud.points = sph_points_periodic(c->cloud.points, lx, ly, lz);
    c->cloud.checked = 0;
}
void sph_shim_cloud_range(sph_shim_cloud *c, sph_index first, sph_index last)
{
    c->cloud = sph_cloud_range(c->cloud, first, last);
    if (c->cloud.checked < 0) c->cloud.checked = 0;
}
int sph_shim_cloud_check(sph_shim_cloud *c)
{
    c->cloud = sph_cloud_checked(c->dim, c->cloud);
    return c->cloud.checked < 0 ? c->cloud.checked : 0;
}

size_t sph_shim_grid_workspace(int dim, sph_index n) { return sph_grid_workspace(dim, n); }
sph_index sph_shim_grid_lists(const sph_shim_cloud *c, int criterion, const sph_real *radius,
                              size_t radius_stride, void *work, size_t work_size, sph_index *start,
                              sph_index *index, size_t capacity, int64_t *pairs)
{
    const sph_points x = c->cloud.points;
    const sph_scalars R = sph_scalars_strided(radius, radius_stride);
    const sph_query query = sph_query_of(x, criterion, R, 0);
    sph_real reach = SPH_R(0);
    sph_grid grid;
    sph_index i, error;
    if (!radius && x.n > 0) return SPH_ERROR_NULL;
    for (i = 0; i < (x.n > 0 && !radius_stride ? 1 : x.n); i++)
        if (radius[(size_t)i * radius_stride] > reach) reach = radius[(size_t)i * radius_stride];
    error = sph_grid_build(c->dim, x, reach, work, work_size, &grid);
    if (error) return error;
    if (!index && capacity == 0) return sph_grid_count(c->dim, &grid, query, start, pairs);
    return sph_grid_lists(c->dim, &grid, query, start, index, (int64_t)capacity, pairs);
}

/* ---------------------------------------------------------------- sweeps */

sph_index sph_shim_density_summation(const sph_shim_cloud *c, const sph_real *m, size_t m_stride,
                                     sph_real *rho)
{
    sph_index answer = SPH_ERROR_KERNEL;
    const sph_scalars mass = sph_scalars_strided(m, m_stride);
    const sph_scalar_out out = sph_scalar_out_array(rho, 0);
#define SWEEP(K, D) sph_density_summation(K, D, c->cloud, mass, out)
    SHIM_SWITCH_KERNEL(c->kernel, EVERY_DIM)
#undef SWEEP
    return answer;
}
sph_index sph_shim_gradient_cspm(const sph_shim_cloud *c, const sph_real *f, size_t f_stride, sph_real *gx,
                                 sph_real *gy, sph_real *gz, unsigned char *status)
{
    const sph_derivatives_out out = {.gx = gx, .gy = gy, .gz = gz, .status = status};
    sph_index answer = SPH_ERROR_KERNEL;
#define SWEEP(K, D) sph_gradient_cspm(K, D, c->cloud, sph_scalars_strided(f, f_stride), out)
    SHIM_SWITCH_KERNEL(c->kernel, EVERY_DIM)
#undef SWEEP
    return answer;
}
sph_index sph_shim_laplacian_brookshaw(const sph_shim_cloud *c, const sph_real *f, size_t f_stride,
                                       sph_real *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    const sph_scalars field = sph_scalars_strided(f, f_stride);
    const sph_scalar_out to = sph_scalar_out_array(out, 0);
#define SWEEP(K, D) sph_laplacian_brookshaw(K, D, c->cloud, field, to)
    SHIM_SWITCH_KERNEL(c->kernel, EVERY_DIM)
#undef SWEEP
    return answer;
}
sph_index sph_shim_derivatives_icspm(const sph_shim_cloud *c, const sph_real *f, size_t f_stride,
                                     sph_real conditioning_min, int fallback_wls, sph_real *out,
                                     unsigned char *status)
{
    sph_index answer = SPH_ERROR_KERNEL;
    const sph_derivatives_options options = {conditioning_min, fallback_wls};
    sph_derivatives_out o = {0};
    if (c->cloud.points.n == 0) return 0; /* out may be null */
    if (!out) return SPH_ERROR_NULL;
    o.gx = out;
    o.hxx = out + c->dim;
    if (c->dim > 1) o.gy = out + 1, o.hxy = o.hxx + 1, o.hyy = o.hxx + 2;
    if (c->dim > 2) o.gz = out + 2, o.hxz = o.hxx + 3, o.hyz = o.hxx + 4, o.hzz = o.hxx + 5;
    o.stride = c->dim == 1 ? 2 : c->dim == 2 ? 5 : 9;
    o.status = status;
#define SWEEP(K, D) sph_derivatives_icspm(K, D, c->cloud, sph_scalars_strided(f, f_stride), options, o)
    EVERY_DIM((sph_kernel)c->kernel) /* one copy: what its 14 or 50 sums cost hides the switch */
#undef SWEEP
    return answer;
}

sph_index sph_shim_elliptic_rows_msph(const sph_shim_cloud *c, const sph_real *m, size_t m_stride, int trace,
                                      sph_real *row, sph_real *diagonal, unsigned char *status)
{
    sph_index answer = SPH_ERROR_KERNEL;
    sph_elliptic_options options = {0};
    sph_rows_out out = {0};
    options.trace = trace;
    out.row = row;
    out.diagonal = diagonal;
    out.status = status;
#define SWEEP(K, D) sph_elliptic_rows_msph(K, D, c->cloud, sph_scalars_strided(m, m_stride), options, out)
    SHIM_SWITCH_KERNEL(c->kernel, EVERY_DIM)
#undef SWEEP
    return answer;
}

sph_index sph_shim_rows_apply(const sph_shim_cloud *c, const sph_real *row, const sph_real *diagonal,
                              const sph_real *u, size_t u_stride, sph_real *out)
{
    const sph_scalars field = sph_scalars_strided(u, u_stride);
    return sph_rows_apply(c->cloud, row, sph_scalars_array(diagonal), field, sph_scalar_out_array(out, 0));
}
sph_index sph_shim_collision_sequential(const sph_shim_cloud *c, sph_real distance,
                                        const sph_real *inverse_mass, size_t inverse_mass_stride,
                                        sph_real restitution, sph_real *vx, sph_real *vy, sph_real *vz,
                                        size_t stride)
{
    const sph_scalars inverse = sph_scalars_strided(inverse_mass, inverse_mass_stride);
    const sph_collision collision = {distance, restitution, inverse};
    return sph_collision_sequential(c->dim, c->cloud, collision, sph_vector_out_strided(vx, vy, vz, stride),
                                    0);
}
