/* SPDX-License-Identifier: MIT
 *
 * elliptic_msph_diagonal.h - M-SPH with a mobility for each axis, (69) of Lukyanov & Vuik 2020
 * (arXiv:1711.11351) with a diagonal matrix M, as published, to compare with sph_elliptic_rows_anisotropic,
 * which is the one to use.
 */
#ifndef ELLIPTIC_MSPH_DIAGONAL_H
#define ELLIPTIC_MSPH_DIAGONAL_H

#include "../../sph_ops.h"

static inline sph_real elliptic_at(sph_scalars a, sph_index i) { return a.p[(size_t)i * a.stride]; }

/* x_j - x_i, in an open box */
static inline sph_vec elliptic_towards(int dim, sph_points x, sph_index i, sph_index j)
{
    const size_t a = (size_t)i * x.stride, b = (size_t)j * x.stride;
    sph_vec e;
    e.x = x.x[b] - x.x[a];
    e.y = dim > 1 ? x.y[b] - x.y[a] : SPH_R(0);
    e.z = dim > 2 ? x.z[b] - x.z[a] : SPH_R(0);
    return e;
}
/* V_j G with G = -F(r, (h_i + h_j) / 2): the gradient (15) is G e */
SPH_FN sph_real elliptic_weight(sph_kernel k, int dim, sph_cloud all, sph_vec e, sph_index i, sph_index j)
{
    return -elliptic_at(all.volume, j) *
           sph_kernel_f(k, dim, sph_length(dim, e),
                        SPH_R(0.5) * (elliptic_at(all.h, i) + elliptic_at(all.h, j)));
}

/* Rows of div(M grad u), arithmetic means, with the gradient (15), so that K = Gamma and N~ = N:
       row = scale V_j G sum_a (M_i + M_j)_a (e_a^2 / |e|^2 - N_a (K^-1 e)_a),   scale = tr K^-1 / dim,
       K = sum V_j G e e^T,   N = sum V_j G e.
   INCONSISTENT unless M is isotropic or all neighbours lie on the axes (on lattices: support below sqrt(2)
   spacings): for M = diag(1, 0) and many neighbours it gives 3/2 and 1/2 for x^2 and y^2, not 2 and 0, at any
   resolution. Returns the number of targets whose K is singular: their rows are 0. */
SPH_FN sph_index elliptic_rows_msph_diagonal(sph_kernel k, int dim, sph_cloud all, sph_diagonal mobility,
                                             sph_real *row)
{
    sph_index i, p, failed = 0;
    for (i = all.first; i < all.last; i++) {
        sph_sym sum = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)};
        sph_mat inverse;
        sph_elliptic_moments moments;
        sph_vec n;
        sph_real scale = SPH_R(0);
        int singular;
        n.x = n.y = n.z = SPH_R(0);
        for (p = all.list.start[i]; p < all.list.start[i + 1]; p++) {
            const sph_index j = all.list.index[p];
            const sph_vec e = elliptic_towards(dim, all.points, i, j),
                          we = sph_scale(elliptic_weight(k, dim, all, e, i, j), e);
            sum.xx += we.x * e.x;
            sum.xy += we.x * e.y;
            sum.yy += we.y * e.y;
            sum.xz += we.x * e.z;
            sum.yz += we.y * e.z;
            sum.zz += we.z * e.z;
            n.x += we.x;
            n.y += we.y;
            n.z += we.z;
        }
        moments = sph_elliptic_moments_radial(sum, n);
        singular = sph_elliptic_invert(dim, SPH_GRADIENT_DIFFUSE, &moments, &inverse, 0) != SPH_OK;
        failed += singular;
        if (!singular)
            scale = (inverse.x.x + (dim > 1 ? inverse.y.y : SPH_R(0)) + (dim > 2 ? inverse.z.z : SPH_R(0))) /
                    SPH_R(dim);
        for (p = all.list.start[i]; p < all.list.start[i + 1]; p++) {
            const sph_index j = all.list.index[p];
            const sph_vec e = elliptic_towards(dim, all.points, i, j);
            sph_vec mu_n, mu_e;
            mu_n.x = elliptic_at(mobility.x, i) + elliptic_at(mobility.x, j);
            mu_n.y = dim > 1 ? elliptic_at(mobility.y, i) + elliptic_at(mobility.y, j) : SPH_R(0);
            mu_n.z = dim > 2 ? elliptic_at(mobility.z, i) + elliptic_at(mobility.z, j) : SPH_R(0);
            mu_e.x = mu_n.x * e.x;
            mu_e.y = mu_n.y * e.y;
            mu_e.z = mu_n.z * e.z;
            mu_n.x *= n.x;
            mu_n.y *= n.y;
            mu_n.z *= n.z;
            row[p] = SPH_R(0);
            if (!singular)
                row[p] = scale * elliptic_weight(k, dim, all, e, i, j) *
                         (sph_dot(dim, mu_e, e) / sph_dot(dim, e, e) -
                          sph_dot(dim, sph_mat_times(dim, inverse, mu_n), e));
        }
    }
    return failed;
}

#endif
