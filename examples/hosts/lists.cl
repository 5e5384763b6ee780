/* SPDX-License-Identifier: MIT
 *
 * lists.cl - lists.h as an OpenCL program, and a sweep on its lists; host_opencl_lists.c calls it.
 */
#if !SPH_SINGLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define SPH_CHECK 0
#include "sph.h"

#include "examples/hosts/lists.h"

__kernel void density(int n, int n_total, cells g, __global const sph_real *x, __global const int *start,
                      __global const int *index, __global const sph_real *h, __global const sph_real *m,
                      __global sph_real *rho)
{
    const int i = (int)get_global_id(0);
    const sph_list list = {start, index};
    const sph_cloud all =
        sph_cloud_of(cells_points(g, n_total, x), list, sph_scalars_array(h), sph_scalars_none());
    if (i < n)
        sph_density_summation(SPH_WENDLAND_C2, 3, sph_cloud_range(all, i, i + 1), sph_scalars_array(m),
                              sph_scalar_out_array(rho, 0));
}
