/* SPDX-License-Identifier: MIT
 *
 * laplacian_kernel.h - the oldest SPH Laplacian, with the second derivative of the kernel (Monaghan 2005,
 * Rep. Prog. Phys. 68, 1703, section 2), to compare with. Do not use it: its weights change sign inside the
 * support, and it is very sensitive to disorder, as the introduction of the ICSPM paper says and
 * icspm_uniform shows. sph_laplacian_brookshaw takes the first derivative.
 */
#ifndef LAPLACIAN_KERNEL_H
#define LAPLACIAN_KERNEL_H

#include "../../sph_ops.h"

/* L f_i = sum_j V_j (f_j - f_i) lap W_ij,  lap W = d2W/dr2 + (dim - 1) F,  in an open box */
SPH_FN void laplacian_kernel(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f, sph_real *out)
{
    const sph_points x = cloud.points;
    sph_index i, p;
    for (i = cloud.first; i < cloud.last; i++) {
        const size_t a = (size_t)i * x.stride;
        const sph_real h_i = cloud.h.p[(size_t)i * cloud.h.stride];
        sph_real sum = SPH_R(0);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const size_t b = (size_t)j * x.stride;
            const sph_real V_j = cloud.volume.p[(size_t)j * cloud.volume.stride],
                           df = f.p[(size_t)j * f.stride] - f.p[(size_t)i * f.stride];
            sph_vec x_ij;
            sph_real r;
            x_ij.x = x.x[a] - x.x[b];
            x_ij.y = dim > 1 ? x.y[a] - x.y[b] : SPH_R(0);
            x_ij.z = dim > 2 ? x.z[a] - x.z[b] : SPH_R(0);
            r = sph_length(dim, x_ij);
            sum += V_j * df *
                   (sph_kernel_d2wdr2(k, dim, r, h_i) + SPH_R(dim - 1) * sph_kernel_f(k, dim, r, h_i));
        }
        out[i] = sum;
    }
}

#endif
