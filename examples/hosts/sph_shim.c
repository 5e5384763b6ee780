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

/* The headers' functions are not inlined by force, because all sweeps in all dimensions would take minutes to
   compile; where kernel and dimension are constants, FLATTEN inlines all that is called below. */
#if defined(__GNUC__)
#define FLATTEN __attribute__((flatten))
#ifndef SPH_FN
#define SPH_FN static __attribute__((unused))
#endif
#else
#define FLATTEN
#endif
#include "sph_shim.h"

#include <string.h>


/* Every sweep is compiled once for each dimension, and asks for the kernel at each pair. Those of FOLDED in
   generate.py are compiled again with these kernels as constants, which fold: they take half of the time.
   Put yours here, or define it with -D; it may be empty, and the shim is then compiled in a third of the
   time. */
#ifndef SHIM_CONSTANT_KERNELS
#define SHIM_CONSTANT_KERNELS(EACH) EACH(SPH_CUBIC_SPLINE) EACH(SPH_WENDLAND_C2)
#endif
/* SWEEP(K, D), SWEEP(K) or SWEEP(D) is the call of the inline function. */
#define BY_DIM(one, two, three) \
    answer = dim == 1 ? one : dim == 2 ? two : dim == 3 ? three : refuse("dim", SPH_ERROR_DIM);
#define EVERY_DIM BY_DIM(SWEEP(1), SWEEP(2), SWEEP(3))
#define EVERY_KERNEL answer = SWEEP((sph_kernel)kernel);
#define KERNEL_AND_DIM(K) BY_DIM(SWEEP(K, 1), SWEEP(K, 2), SWEEP(K, 3))
#define EVERY_KERNEL_AND_DIM KERNEL_AND_DIM((sph_kernel)kernel)
#define IF_CONSTANT(K) \
    if (kernel == (int)(K)) { KERNEL_AND_DIM(K) }
#define CONSTANT_KERNEL_AND_DIM SHIM_CONSTANT_KERNELS(IF_CONSTANT)
#define OR_CONSTANT(K) || kernel == (int)(K)
#define IS_CONSTANT(kernel) (0 SHIM_CONSTANT_KERNELS(OR_CONSTANT))
/* the struct of a host, or one of zeros */
#define GIVEN(type, pointer) ((pointer) ? *(pointer) : (type){0})

static int refuse(const char *argument, int error)
{
    SPH_REFUSED(argument, -1, error);
    return error;
}
static int missing(const char *argument) { return refuse(argument, SPH_ERROR_NULL); }

int sph_shim_version(void) { return SPH_VERSION; }
int sph_shim_real_size(void) { return (int)sizeof(sph_real); }
int sph_shim_index_size(void) { return (int)sizeof(sph_index); }
const char *sph_shim_refused(int error, sph_index *particle)
{
    const char *const argument = refused_error == error && refused_argument ? refused_argument : "";
    if (particle) *particle = *argument ? (sph_index)refused_particle : -1;
    refused_error = 0;
    return argument;
}

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

int sph_shim_cloud_checked(int dim, sph_cloud *cloud)
{
    if (!cloud) return missing("cloud");
    *cloud = sph_cloud_checked(dim, *cloud);
    return cloud->checked < 0 ? cloud->checked : 0;
}
void sph_shim_cloud_range(sph_cloud *cloud, sph_index first, sph_index last)
{
    *cloud = sph_cloud_range(*cloud, first, last);
    if (cloud->checked < 0) cloud->checked = 0; /* the sweeps say what is wrong with the new range */
}

#include "sph_shim_sweeps.c" /* one file to compile, and the switch above */
