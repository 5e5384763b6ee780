/* SPDX-License-Identifier: MIT
 *
 * sph_shim.h - sph.h behind exported symbols, for hosts that cannot include a C header: Fortran, Python,
 * JavaScript, Julia, Rust, ...
 *
 *     cc -O2 -shared -fPIC -I. examples/hosts/sph_shim.c -o libsph_shim.so -lm        a shared library
 *     cc -O2 -c -I. examples/hosts/sph_shim.c                                         an object to link with
 *
 * Kernel and dimension are chosen at run time, once per sweep (which kernels are compiled as constants:
 * sph_shim.c). What the operators compute, their arguments and answers: sph_ops.h, under the same name
 * without _shim. Whatever else of it a host needs is exported by four lines like those of its neighbours.
 *
 * Positions, h, V and lists stay where they are in the host's memory; a cloud holds their addresses. It is
 * set up in memory of the host's, sph_shim_cloud_size() bytes aligned to 8, and valid as long as the arrays
 * are:
 *
 *     sph_shim_cloud_init(c, kernel, dim, n, x, y, z, stride);  y, z may be null below dim 2, 3
 *     sph_shim_cloud_volumes(c, h, h_stride, V, V_stride);      a stride of 0: one value for all
 *     sph_shim_cloud_lists(c, start, index);                    the host's own, or of sph_shim_grid_lists;
 *                                                               they begin with 0, in every language
 *     sph_shim_cloud_periodic(c, lx, ly, lz);                   if wanted; 0 leaves an axis open
 *     sph_shim_cloud_range(c, first, last);                     targets of the sweeps, if not all: threads
 *                                                               share the work by clouds with ranges
 *     sph_shim_cloud_check(c);                                  if wanted, when all of the above is there:
 *                                                               scans it once, and not in each sweep
 *
 * A cloud may be empty: with n = 0 all arrays may be null, and all sweeps answer 0. All strides count
 * sph_real. Sweeps return the number of targets that are not ok (0: all well), or a negative sph_error, which
 * sph_shim_status_text puts in words; sph_shim_refused says which argument it was, and at which particle.
 */
#ifndef SPH_SHIM_H
#define SPH_SHIM_H

#include "sph.h"

#if defined(_WIN32)
#define SPH_SHIM_EXPORT __declspec(dllexport)
#elif defined(__EMSCRIPTEN__)
#define SPH_SHIM_EXPORT __attribute__((used, visibility("default")))
#elif defined(__GNUC__)
#define SPH_SHIM_EXPORT __attribute__((visibility("default")))
#else
#define SPH_SHIM_EXPORT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* what the library was compiled as: SPH_VERSION, and bytes of sph_real and sph_index */
SPH_SHIM_EXPORT int sph_shim_version(void);
SPH_SHIM_EXPORT int sph_shim_real_size(void);
SPH_SHIM_EXPORT int sph_shim_index_size(void);

SPH_SHIM_EXPORT int sph_shim_kernel_from_name(const char *name); /* or -1 */
SPH_SHIM_EXPORT const char *sph_shim_status_text(int status);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_support(int kernel); /* support radius / h; 0: no such kernel */
/* The name of the argument for which this thread was last answered this error, and the first particle at
   fault (from 0; -1: none); "" if that is not known. It is told once. */
SPH_SHIM_EXPORT const char *sph_shim_refused(int error, sph_index *particle);
/* W and F = (1/r) dW/dr of n distances; w or f may be null */
SPH_SHIM_EXPORT int sph_shim_kernel_wf(int kernel, int dim, sph_index n, const sph_real *r, sph_real h,
                                       sph_real *w, sph_real *f);

typedef struct sph_shim_cloud sph_shim_cloud;
SPH_SHIM_EXPORT size_t sph_shim_cloud_size(void);
SPH_SHIM_EXPORT int sph_shim_cloud_init(sph_shim_cloud *c, int kernel, int dim, sph_index n,
                                        const sph_real *x, const sph_real *y, const sph_real *z,
                                        size_t stride);
SPH_SHIM_EXPORT void sph_shim_cloud_volumes(sph_shim_cloud *c, const sph_real *h, size_t h_stride,
                                            const sph_real *V, size_t V_stride);
SPH_SHIM_EXPORT void sph_shim_cloud_lists(sph_shim_cloud *c, const sph_index *start, const sph_index *index);
SPH_SHIM_EXPORT void sph_shim_cloud_periodic(sph_shim_cloud *c, sph_real lx, sph_real ly, sph_real lz);
SPH_SHIM_EXPORT void sph_shim_cloud_range(sph_shim_cloud *c, sph_index first, sph_index last);
/* 0, or the negative sph_error that the sweeps will answer, too. What is set later has to be checked again.
   */
SPH_SHIM_EXPORT int sph_shim_cloud_check(sph_shim_cloud *c);

/* Neighbour lists of the cloud (sph_grid_build and sph_grid_lists), by an sph_criterion, with support radii
   `radius`: start[n + 1], index[capacity]; *pairs entries are needed. index = null and capacity = 0 counts
   only. work: sph_shim_grid_workspace(dim, n) bytes. */
SPH_SHIM_EXPORT size_t sph_shim_grid_workspace(int dim, sph_index n);
SPH_SHIM_EXPORT sph_index sph_shim_grid_lists(const sph_shim_cloud *c, int criterion, const sph_real *radius,
                                              size_t radius_stride, void *work, size_t work_size,
                                              sph_index *start, sph_index *index, size_t capacity,
                                              int64_t *pairs);

/* The sweeps. Outputs are contiguous, of the cloud's n; gy, gz may be null below dim 2, 3, status always. */
SPH_SHIM_EXPORT sph_index sph_shim_density_summation(const sph_shim_cloud *c, const sph_real *m,
                                                     size_t m_stride, sph_real *rho);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_cspm(const sph_shim_cloud *c, const sph_real *f, size_t f_stride,
                                                 sph_real *gx, sph_real *gy, sph_real *gz,
                                                 unsigned char *status);
SPH_SHIM_EXPORT sph_index sph_shim_laplacian_brookshaw(const sph_shim_cloud *c, const sph_real *f,
                                                       size_t f_stride, sph_real *out);
/* out: 2, 5 or 9 numbers per particle in 1D, 2D, 3D: gx, xx; gx, gy, xx, xy, yy; gx, gy, gz, xx, xy, yy, xz,
   yz, zz */
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_icspm(const sph_shim_cloud *c, const sph_real *f,
                                                     size_t f_stride, sph_real conditioning_min,
                                                     int fallback_wls, sph_real *out, unsigned char *status);
/* rows of div(m grad u) (row: as long as the list's index; diagonal: n, may be null), with the gradient (15)
   and arithmetic means; trace: 0 or 1, see sph_elliptic_options */
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_msph(const sph_shim_cloud *c, const sph_real *m,
                                                      size_t m_stride, int trace, sph_real *row,
                                                      sph_real *diagonal, unsigned char *status);
SPH_SHIM_EXPORT sph_index sph_shim_rows_apply(const sph_shim_cloud *c, const sph_real *row,
                                              const sph_real *diagonal, const sph_real *u, size_t u_stride,
                                              sph_real *out);
/* changes the velocities (stride between particles); inverse_mass 0: a wall */
SPH_SHIM_EXPORT sph_index sph_shim_collision_sequential(const sph_shim_cloud *c, sph_real distance,
                                                        const sph_real *inverse_mass,
                                                        size_t inverse_mass_stride, sph_real restitution,
                                                        sph_real *vx, sph_real *vy, sph_real *vz,
                                                        size_t stride);

#ifdef __cplusplus
}
#endif

#endif
