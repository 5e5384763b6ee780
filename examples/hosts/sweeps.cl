/* SPDX-License-Identifier: MIT */
/* sweeps.cl - the sweeps of sph_ops.h in OpenCL C: a work item is the range [i, i + 1) of targets. Pointers
   cannot be passed inside structs in OpenCL: the cloud is made here. Every operator on a cloud is called in
   this way: its kernel takes the arrays as arguments, fills the structs, and calls the sweep on that range.
   (Collisions in sequence, and what answers one number for all targets, are for one work item.) */
#if defined(cl_khr_fp64) && !SPH_SINGLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define SPH_CHECK 0 /* the host has checked */
#include "sph_ops.h"

__kernel void density(sph_index n, __global const sph_real *x, __global const sph_real *y,
                      __global const sph_real *z, __global const sph_index *start,
                      __global const sph_index *index, __global const sph_real *h, __global const sph_real *m,
                      __global sph_real *rho)
{
    const sph_index i = (sph_index)get_global_id(0);
    const sph_list list = {start, index};
    const sph_points points = sph_points_separate(n, x, y, z);
    const sph_cloud cloud = sph_cloud_of(points, list, sph_scalars_same(h), sph_scalars_none());
    if (i < n)
        sph_density_summation(SPH_WENDLAND_C2, 3, sph_cloud_range(cloud, i, i + 1), sph_scalars_array(m),
                              sph_scalar_out_array(rho, 0));
}

__kernel void msph(sph_index n, __global const sph_real *x, __global const sph_real *y,
                   __global const sph_real *z, __global const sph_index *start,
                   __global const sph_index *index, __global const sph_real *h, __global const sph_real *V,
                   __global const sph_real *mobility, __global const sph_real *u,
                   __global sph_real *laplacian)
{
    const sph_index i = (sph_index)get_global_id(0);
    const sph_list list = {start, index};
    const sph_points points = sph_points_separate(n, x, y, z);
    const sph_cloud cloud = sph_cloud_of(points, list, sph_scalars_same(h), sph_scalars_array(V));
    const sph_elliptic_options options = {0};
    if (i < n)
        sph_elliptic_msph(SPH_WENDLAND_C2, 3, sph_cloud_range(cloud, i, i + 1), sph_scalars_array(mobility),
                          options, sph_scalars_array(u), sph_scalar_out_array(laplacian, 0));
}

/* W and F of kernels that are chosen at run time */
__kernel void known(__global const int *k, __global const int *dim, __global const sph_real *r,
                    __global const sph_real *h, __global sph_real *w, __global sph_real *f)
{
    const size_t i = get_global_id(0);
    const sph_wf v = sph_kernel_wf((sph_kernel)k[i], dim[i], r[i], h[i]);
    w[i] = v.w;
    f[i] = v.f;
}
