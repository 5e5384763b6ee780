/* SPDX-License-Identifier: MIT
 *
 * sph_shim.h - sph.h behind exported symbols, for hosts that cannot include a C header: Fortran, Python,
 * JavaScript, Julia, Rust, ...
 *
 *     cc -O2 -shared -fPIC -I. examples/hosts/sph_shim.c -o libsph_shim.so -lm        a shared library
 *     cc -O2 -c -I. examples/hosts/sph_shim.c                                         an object to link with
 *
 * Every operator of the headers is here, under its name with sph_shim_ in front; what it computes, its
 * arguments and answers: sph_ops.h and sph.h. What differs:
 *
 *     Kernel and dimension are numbers of run time, and are dispatched once per sweep (which kernels are
 *     compiled as constants: sph_shim.c).
 *     Structs are passed by their address, and filled by the host: they hold addresses and numbers, in the
 *     layout of C. generate.py writes them down for Python and for Fortran; sph_shim_struct_size lets a host
 *     compare. A null address stands for a struct of zeros: the defaults of options, no values, outputs that
 *     are not wanted. A cloud, points, query or grid must be there.
 *
 * To begin with, fill an sph_points (n, x, y, z, stride; a box of zeros is open), let sph_shim_search find
 * the neighbours, and fill an sph_cloud: points, the list that was found, h, volume, first = 0, last = n and
 * zeros. It is valid as long as the arrays are. If it is to be scanned once, and not in each sweep, call
 * sph_shim_cloud_checked; who changes a member later sets `checked` to 0 again.
 *
 * A cloud may be empty: with n = 0 all arrays may be null, and all sweeps answer 0. Lists count from 0, in
 * every language; all strides count sph_real. Sweeps return the number of targets that are not ok (0: all
 * well), or a negative sph_error, which sph_shim_status_text puts in words; sph_shim_refused says which
 * argument it was, and at which particle.
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

/* what the library was compiled as: SPH_VERSION, bytes of sph_real, of sph_index, and of a struct by its name
   (0: there is none) */
SPH_SHIM_EXPORT int sph_shim_version(void);
SPH_SHIM_EXPORT int sph_shim_real_size(void);
SPH_SHIM_EXPORT int sph_shim_index_size(void);
SPH_SHIM_EXPORT size_t sph_shim_struct_size(const char *name);

/* The name of the argument for which this thread was last answered this error, and the first particle at
   fault (from 0; -1: none); "" if that is not known. It is told once. */
SPH_SHIM_EXPORT const char *sph_shim_refused(int error, sph_index *particle);
/* W and F = (1/r) dW/dr of n distances; w or f may be null */
SPH_SHIM_EXPORT int sph_shim_kernel_wf(int kernel, int dim, sph_index n, const sph_real *r, sph_real h,
                                       sph_real *w, sph_real *f);
/* Scans a cloud, once for all sweeps, and marks it: 0, or the negative sph_error that they answer, too. */
SPH_SHIM_EXPORT int sph_shim_cloud_checked(int dim, sph_cloud *cloud);
/* Other targets: first ... last - 1. The mark stays if they are among the old ones. */
SPH_SHIM_EXPORT void sph_shim_cloud_range(sph_cloud *cloud, sph_index first, sph_index last);

#include "sph_shim_sweeps.h"

#ifdef __cplusplus
}
#endif

#endif
