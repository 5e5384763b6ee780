/* SPDX-License-Identifier: MIT
 *
 * cleaning_forms.h - the pairs of operators for divergence cleaning that the paper (Tricco & Price 2012)
 * warns of, to compare with sph_cleaning_rates, which has the symmetric form of grad psi, (23), with the
 * difference form of div B, (20), and keeps the energy of B and psi. With F = F(r, h_i)
 *     difference form of div B     -sum_j m_j (B_i - B_j) . x_ij F / (Omega_i rho_i)
 *     difference form of grad psi   sum_j m_j (psi_j - psi_i) x_ij F / (Omega_i rho_i)
 *     symmetric form of div B       rho_i sum_j m_j (B_i g_i + B_j g_j) . x_ij, see sph_divergence_symmetric
 * Arguments and answers are those of sph_cleaning_rates.
 */
#ifndef CLEANING_FORMS_H
#define CLEANING_FORMS_H

#include "../../sph_ops.h"

static inline sph_real cleaning_at(sph_scalars a, sph_index i) { return a.p[(size_t)i * a.stride]; }

/* -grad psi in difference form, and dpsi/dt from the div B that stands in rate_psi */
SPH_FN sph_index cleaning_rates_of(sph_kernel k, int dim, sph_cloud cloud, sph_cleaning s,
                                   sph_cleaning_out out)
{
    const size_t stride_B = out.rate_B.stride ? out.rate_B.stride : 1, stride = out.stride ? out.stride : 1;
    sph_index i, failed;
    cloud.volume = s.medium.m;
    failed = sph_gradient_difference(k, dim, cloud, s.psi, out.rate_B);
    for (i = cloud.first; i < cloud.last && failed >= 0; i++) {
        const size_t at = (size_t)i * stride, at_B = (size_t)i * stride_B;
        const sph_real scale = SPH_R(-1) / (cleaning_at(s.medium.omega, i) * cleaning_at(s.medium.rho, i)),
                       div_B = out.rate_psi[at];
        sph_cleaning_wave wave;
        wave.ch = s.ch;
        wave.sigma = s.sigma;
        wave.h = cleaning_at(cloud.h, i);
        out.rate_B.x[at_B] *= scale;
        if (dim > 1) out.rate_B.y[at_B] *= scale;
        if (dim > 2) out.rate_B.z[at_B] *= scale;
        if (out.div_B) out.div_B[at] = div_B;
        out.rate_psi[at] = sph_cleaning_rate(wave, cleaning_at(s.psi, i), div_B,
                                             s.div_v.p ? cleaning_at(s.div_v, i) : SPH_R(0));
    }
    return failed;
}

/* The pair of difference forms that came before. DO NOT USE: it does not conserve energy, and grows
   exponentially at free boundaries and density jumps (tests/test_cleaning.c, cleaning_disc). */
SPH_FN sph_index cleaning_rates_nonconservative(sph_kernel k, int dim, sph_cloud cloud, sph_cleaning s,
                                                sph_cleaning_out out)
{
    const sph_scalar_out div_B = sph_scalar_out_strided(out.rate_psi, out.stride, out.status);
    const sph_index failed = sph_divergence_difference(k, dim, cloud, s.medium, s.field, div_B);
    return failed ? failed : cleaning_rates_of(k, dim, cloud, s, out);
}
/* The other conjugate pair: div B symmetric, grad psi in difference form. Conserves energy, too, but cleans
   the disorder of the particles out of B: it dissipates magnetic energy (cleaning_disc). */
SPH_FN sph_index cleaning_rates_symmetric(sph_kernel k, int dim, sph_cloud cloud, sph_cleaning s,
                                          sph_cleaning_out out)
{
    const sph_scalar_out div_B = sph_scalar_out_strided(out.rate_psi, out.stride, out.status);
    const sph_index failed = sph_divergence_symmetric(k, dim, cloud, s.medium, s.field, div_B);
    return failed ? failed : cleaning_rates_of(k, dim, cloud, s, out);
}

#endif
