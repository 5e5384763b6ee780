/* SPDX-License-Identifier: MIT
 *
 * sph_shim_sweeps.c - part of sph_shim.c, which includes it. Written by examples/hosts/generate.py from
 * the headers: run it again instead of changing this file. */
sph_real sph_shim_kernel_support_ratio(int kernel)
{
    return sph_kernel_support_ratio((sph_kernel)kernel);
}
sph_real sph_shim_kernel_h_over_dx(int kernel)
{
    return sph_kernel_h_over_dx((sph_kernel)kernel);
}
sph_real sph_shim_kernel_h_from_support(int kernel, sph_real support)
{
    return sph_kernel_h_from_support((sph_kernel)kernel, support);
}
sph_real sph_shim_kernel_support(int kernel, sph_real h)
{
    return sph_kernel_support((sph_kernel)kernel, h);
}
sph_real sph_shim_kernel_sigma(int kernel, int dim)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_sigma((sph_kernel)kernel, dim);
}
sph_real sph_shim_kernel_shape(int kernel, int dim, sph_real q)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_shape((sph_kernel)kernel, dim, q);
}
sph_real sph_shim_kernel_shape_f(int kernel, int dim, sph_real q)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_shape_f((sph_kernel)kernel, dim, q);
}
sph_real sph_shim_kernel_shape_d2(int kernel, int dim, sph_real q)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_shape_d2((sph_kernel)kernel, dim, q);
}
sph_real sph_shim_kernel_w(int kernel, int dim, sph_real r, sph_real h)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_w((sph_kernel)kernel, dim, r, h);
}
sph_real sph_shim_kernel_f(int kernel, int dim, sph_real r, sph_real h)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_f((sph_kernel)kernel, dim, r, h);
}
sph_real sph_shim_kernel_dwdr(int kernel, int dim, sph_real r, sph_real h)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_dwdr((sph_kernel)kernel, dim, r, h);
}
sph_real sph_shim_kernel_d2wdr2(int kernel, int dim, sph_real r, sph_real h)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_d2wdr2((sph_kernel)kernel, dim, r, h);
}
sph_real sph_shim_kernel_dwdh(int kernel, int dim, sph_real r, sph_real h)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_dwdh((sph_kernel)kernel, dim, r, h);
}
int sph_shim_kernel_has_cusp(int kernel)
{
    return sph_kernel_has_cusp((sph_kernel)kernel);
}
int sph_shim_kernel_may_convexify(int kernel, int dim)
{
    return sph_kernel_may_convexify((sph_kernel)kernel, dim);
}
sph_real sph_shim_cohesion_kernel_akinci(sph_real r, sph_real support)
{
    return sph_cohesion_kernel_akinci(r, support);
}
sph_real sph_shim_adhesion_kernel_akinci(sph_real r, sph_real support)
{
    return sph_adhesion_kernel_akinci(r, support);
}
int sph_shim_kernel_has_gravity(int kernel)
{
    return sph_kernel_has_gravity((sph_kernel)kernel);
}
sph_real sph_shim_gravity_shape_f(int kernel, sph_real q)
{
    return sph_gravity_shape_f((sph_kernel)kernel, q);
}
sph_real sph_shim_gravity_shape(int kernel, sph_real q)
{
    return sph_gravity_shape((sph_kernel)kernel, q);
}
sph_real sph_shim_gravity_potential(int kernel, sph_real r, sph_real h)
{
    return sph_gravity_potential((sph_kernel)kernel, r, h);
}
sph_real sph_shim_gravity_force(int kernel, sph_real r, sph_real h)
{
    return sph_gravity_force((sph_kernel)kernel, r, h);
}
sph_real sph_shim_gravity_dphidh(int kernel, sph_real r, sph_real h)
{
    return sph_gravity_dphidh((sph_kernel)kernel, r, h);
}
const char *sph_shim_kernel_name(int kernel)
{
    return sph_kernel_name((sph_kernel)kernel);
}
int sph_shim_kernel_from_name(const char *name)
{
    return sph_kernel_from_name(name);
}
const char *sph_shim_status_text(int status)
{
    return sph_status_text(status);
}

#define SWEEP(K, D) \
    sph_shepard_sum(K, D, *cloud, GIVEN(sph_scalar_out, out))
sph_index sph_shim_shepard_sum(int kernel, int dim, const sph_cloud *cloud, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_interpolate_shepard(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_scalar_out, out))
sph_index sph_shim_interpolate_shepard(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                       const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_density_summation(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_scalar_out, out))
FLATTEN static sph_index folded_density_summation(int kernel, int dim, const sph_cloud *cloud,
                                                  const sph_scalars *m, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    CONSTANT_KERNEL_AND_DIM
    return answer;
}
sph_index sph_shim_density_summation(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                     const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    if (IS_CONSTANT(kernel)) return folded_density_summation(kernel, dim, cloud, m, out);
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_density_adaptive(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_density_options, options), \
                         GIVEN(sph_density_out, out))
sph_index sph_shim_density_adaptive(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                    const sph_density_options *options, const sph_density_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_laplacian_weight_brookshaw(int kernel, int dim, sph_real r, sph_real h, sph_real V_j)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_laplacian_weight_brookshaw((sph_kernel)kernel, dim, r, h, V_j);
}
sph_real sph_shim_moment_weight_gradient(int kernel, int dim, sph_real r, sph_real h, sph_real V_j)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_moment_weight_gradient((sph_kernel)kernel, dim, r, h, V_j);
}
sph_real sph_shim_moment_weight_iad(int kernel, int dim, sph_real r, sph_real h, sph_real V_j)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_moment_weight_iad((sph_kernel)kernel, dim, r, h, V_j);
}

#define SWEEP(K, D) \
    sph_gradient_difference(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_vector_out, out))
sph_index sph_shim_gradient_difference(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                       const sph_vector_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_cspm(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_derivatives_out, out))
FLATTEN static sph_index folded_gradient_cspm(int kernel, int dim, const sph_cloud *cloud,
                                              const sph_scalars *f, const sph_derivatives_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    CONSTANT_KERNEL_AND_DIM
    return answer;
}
sph_index sph_shim_gradient_cspm(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                 const sph_derivatives_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    if (IS_CONSTANT(kernel)) return folded_gradient_cspm(kernel, dim, cloud, f, out);
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_iad(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_derivatives_out, out))
sph_index sph_shim_gradient_iad(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                const sph_derivatives_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_rows_cspm(K, D, *cloud, GIVEN(sph_gradient_rows_out, out))
sph_index sph_shim_gradient_rows_cspm(int kernel, int dim, const sph_cloud *cloud,
                                      const sph_gradient_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_rows_iad(K, D, *cloud, GIVEN(sph_gradient_rows_out, out))
sph_index sph_shim_gradient_rows_iad(int kernel, int dim, const sph_cloud *cloud,
                                     const sph_gradient_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_correction_cspm(K, D, *cloud, GIVEN(sph_correction_out, out))
sph_index sph_shim_gradient_correction_cspm(int kernel, int dim, const sph_cloud *cloud,
                                            const sph_correction_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_correction_iad(K, D, *cloud, GIVEN(sph_correction_out, out))
sph_index sph_shim_gradient_correction_iad(int kernel, int dim, const sph_cloud *cloud,
                                           const sph_correction_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_laplacian_brookshaw(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_scalar_out, out))
FLATTEN static sph_index folded_laplacian_brookshaw(int kernel, int dim, const sph_cloud *cloud,
                                                    const sph_scalars *f, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    CONSTANT_KERNEL_AND_DIM
    return answer;
}
sph_index sph_shim_laplacian_brookshaw(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                       const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    if (IS_CONSTANT(kernel)) return folded_laplacian_brookshaw(kernel, dim, cloud, f, out);
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_laplacian_rows_brookshaw(K, D, *cloud, GIVEN(sph_rows_out, out))
sph_index sph_shim_laplacian_rows_brookshaw(int kernel, int dim, const sph_cloud *cloud,
                                            const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_cspm(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_derivatives_options, options), \
                         GIVEN(sph_derivatives_out, out))
sph_index sph_shim_derivatives_cspm(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                    const sph_derivatives_options *options, const sph_derivatives_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_icspm(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_derivatives_options, options), \
                          GIVEN(sph_derivatives_out, out))
sph_index sph_shim_derivatives_icspm(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                     const sph_derivatives_options *options, const sph_derivatives_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_fatehi_manzari(K, D, *cloud, GIVEN(sph_scalars, f), \
                                   GIVEN(sph_derivatives_options, options), GIVEN(sph_derivatives_out, out))
sph_index sph_shim_derivatives_fatehi_manzari(int kernel, int dim, const sph_cloud *cloud,
                                              const sph_scalars *f, const sph_derivatives_options *options,
                                              const sph_derivatives_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_wls(K, D, *cloud, GIVEN(sph_scalars, f), GIVEN(sph_derivatives_options, options), \
                        GIVEN(sph_derivatives_out, out))
sph_index sph_shim_derivatives_wls(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *f,
                                   const sph_derivatives_options *options, const sph_derivatives_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_rows_cspm(K, D, *cloud, GIVEN(sph_jet, d), GIVEN(sph_rows_out, out))
sph_index sph_shim_derivatives_rows_cspm(int kernel, int dim, const sph_cloud *cloud, const sph_jet *d,
                                         const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_rows_icspm(K, D, *cloud, GIVEN(sph_jet, d), GIVEN(sph_rows_out, out))
sph_index sph_shim_derivatives_rows_icspm(int kernel, int dim, const sph_cloud *cloud, const sph_jet *d,
                                          const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_rows_fatehi_manzari(K, D, *cloud, GIVEN(sph_jet, d), GIVEN(sph_rows_out, out))
sph_index sph_shim_derivatives_rows_fatehi_manzari(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_jet *d, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_derivatives_rows_wls(K, D, *cloud, GIVEN(sph_jet, d), GIVEN(sph_rows_out, out))
sph_index sph_shim_derivatives_rows_wls(int kernel, int dim, const sph_cloud *cloud, const sph_jet *d,
                                        const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_boundary_weight_bim(int kernel, sph_real e, sph_real normal, sph_real h)
{
    return sph_boundary_weight_bim((sph_kernel)kernel, e, normal, h);
}

#define SWEEP(K) \
    sph_second_derivative_bim(K, *cloud, GIVEN(sph_scalars, f), left, right, GIVEN(sph_scalar_out, out))
sph_index sph_shim_second_derivative_bim(int kernel, const sph_cloud *cloud, const sph_scalars *f,
                                         sph_index left, sph_index right, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL
    return answer;
}
#undef SWEEP

#define SWEEP(K) \
    sph_second_derivative_rows_bim(K, *cloud, left, right, GIVEN(sph_rows_out, out))
sph_index sph_shim_second_derivative_rows_bim(int kernel, const sph_cloud *cloud, sph_index left,
                                              sph_index right, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_interpolate_mls(K, D, *targets_of, GIVEN(sph_sources, sources), GIVEN(sph_scalars, f), \
                        GIVEN(sph_interpolation_options, options), GIVEN(sph_interpolation_out, out))
sph_index sph_shim_interpolate_mls(int kernel, int dim, const sph_cloud *targets_of,
                                   const sph_sources *sources, const sph_scalars *f,
                                   const sph_interpolation_options *options, const sph_interpolation_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!targets_of) return missing("targets_of");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_interpolate_liu(K, D, *targets_of, GIVEN(sph_sources, sources), GIVEN(sph_scalars, f), \
                        GIVEN(sph_interpolation_options, options), GIVEN(sph_interpolation_out, out))
sph_index sph_shim_interpolate_liu(int kernel, int dim, const sph_cloud *targets_of,
                                   const sph_sources *sources, const sph_scalars *f,
                                   const sph_interpolation_options *options, const sph_interpolation_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!targets_of) return missing("targets_of");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_interpolate_rows_mls(K, D, *targets_of, GIVEN(sph_sources, sources), \
                             GIVEN(sph_interpolation_options, options), \
                             GIVEN(sph_interpolation_rows_out, out))
sph_index sph_shim_interpolate_rows_mls(int kernel, int dim, const sph_cloud *targets_of,
                                        const sph_sources *sources, const sph_interpolation_options *options,
                                        const sph_interpolation_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!targets_of) return missing("targets_of");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_interpolate_rows_liu(K, D, *targets_of, GIVEN(sph_sources, sources), \
                             GIVEN(sph_interpolation_options, options), \
                             GIVEN(sph_interpolation_rows_out, out))
sph_index sph_shim_interpolate_rows_liu(int kernel, int dim, const sph_cloud *targets_of,
                                        const sph_sources *sources, const sph_interpolation_options *options,
                                        const sph_interpolation_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!targets_of) return missing("targets_of");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_mobility_pair(int mean, sph_real m_i, sph_real m_j, sph_real upstream)
{
    return sph_mobility_pair(mean, m_i, m_j, upstream);
}

#define SWEEP(K, D) \
    sph_elliptic_brookshaw(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_elliptic_options, options), \
                           GIVEN(sph_scalars, u), GIVEN(sph_scalar_out, out))
sph_index sph_shim_elliptic_brookshaw(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                      const sph_elliptic_options *options, const sph_scalars *u,
                                      const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_brookshaw_corrected(K, D, *cloud, GIVEN(sph_scalars, m), \
                                     GIVEN(sph_elliptic_options, options), GIVEN(sph_scalars, u), \
                                     GIVEN(sph_scalar_out, out))
sph_index sph_shim_elliptic_brookshaw_corrected(int kernel, int dim, const sph_cloud *cloud,
                                                const sph_scalars *m, const sph_elliptic_options *options,
                                                const sph_scalars *u, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_schwaiger(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_elliptic_options, options), \
                           GIVEN(sph_scalars, u), GIVEN(sph_scalar_out, out))
sph_index sph_shim_elliptic_schwaiger(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                      const sph_elliptic_options *options, const sph_scalars *u,
                                      const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_msph(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_elliptic_options, options), \
                      GIVEN(sph_scalars, u), GIVEN(sph_scalar_out, out))
sph_index sph_shim_elliptic_msph(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                 const sph_elliptic_options *options, const sph_scalars *u,
                                 const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_basic_degiuli_ban(K, D, *cloud, GIVEN(sph_scalars, m), \
                                   GIVEN(sph_elliptic_options, options), GIVEN(sph_scalars, u), \
                                   GIVEN(sph_scalar_out, out))
sph_index sph_shim_elliptic_basic_degiuli_ban(int kernel, int dim, const sph_cloud *cloud,
                                              const sph_scalars *m, const sph_elliptic_options *options,
                                              const sph_scalars *u, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_brookshaw(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_elliptic_options, options), \
                                GIVEN(sph_rows_out, out))
sph_index sph_shim_elliptic_rows_brookshaw(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                           const sph_elliptic_options *options, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_brookshaw_corrected(K, D, *cloud, GIVEN(sph_scalars, m), \
                                          GIVEN(sph_elliptic_options, options), GIVEN(sph_rows_out, out))
sph_index sph_shim_elliptic_rows_brookshaw_corrected(int kernel, int dim, const sph_cloud *cloud,
                                                     const sph_scalars *m,
                                                     const sph_elliptic_options *options,
                                                     const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_schwaiger(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_elliptic_options, options), \
                                GIVEN(sph_rows_out, out))
sph_index sph_shim_elliptic_rows_schwaiger(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                           const sph_elliptic_options *options, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_msph(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_elliptic_options, options), \
                           GIVEN(sph_rows_out, out))
FLATTEN static sph_index folded_elliptic_rows_msph(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_scalars *m, const sph_elliptic_options *options,
                                                   const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    CONSTANT_KERNEL_AND_DIM
    return answer;
}
sph_index sph_shim_elliptic_rows_msph(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                      const sph_elliptic_options *options, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    if (IS_CONSTANT(kernel)) return folded_elliptic_rows_msph(kernel, dim, cloud, m, options, out);
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_basic_degiuli_ban(K, D, *cloud, GIVEN(sph_scalars, m), \
                                        GIVEN(sph_elliptic_options, options), GIVEN(sph_rows_out, out))
sph_index sph_shim_elliptic_rows_basic_degiuli_ban(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_scalars *m, const sph_elliptic_options *options,
                                                   const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_diagnose(K, D, *cloud, GIVEN(sph_elliptic_options, options), \
                          GIVEN(sph_elliptic_report, out))
sph_index sph_shim_elliptic_diagnose(int kernel, int dim, const sph_cloud *cloud,
                                     const sph_elliptic_options *options, const sph_elliptic_report *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_anisotropic(K, D, *cloud, GIVEN(sph_diagonal, mobility), GIVEN(sph_rows_out, out))
sph_index sph_shim_elliptic_rows_anisotropic(int kernel, int dim, const sph_cloud *cloud,
                                             const sph_diagonal *mobility, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_tensor(K, D, *cloud, GIVEN(sph_matrices, mobility), GIVEN(sph_scalars, u), \
                        GIVEN(sph_scalar_out, out))
sph_index sph_shim_elliptic_tensor(int kernel, int dim, const sph_cloud *cloud, const sph_matrices *mobility,
                                   const sph_scalars *u, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_tensor(K, D, *cloud, GIVEN(sph_matrices, mobility), GIVEN(sph_rows_out, out))
sph_index sph_shim_elliptic_rows_tensor(int kernel, int dim, const sph_cloud *cloud,
                                        const sph_matrices *mobility, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_elliptic_rows_boundary(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_elliptic_options, options), \
                               GIVEN(sph_boundary, boundary), GIVEN(sph_rows_out, out))
sph_index sph_shim_elliptic_rows_boundary(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                          const sph_elliptic_options *options, const sph_boundary *boundary,
                                          const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

sph_index sph_shim_rows_apply(const sph_cloud *cloud, const sph_real *row, const sph_scalars *diagonal,
                              const sph_scalars *u, const sph_scalar_out *out)
{
    if (!cloud) return missing("cloud");
    return sph_rows_apply(*cloud, row, GIVEN(sph_scalars, diagonal), GIVEN(sph_scalars, u),
                          GIVEN(sph_scalar_out, out));
}

sph_index sph_shim_rows_monotone(const sph_cloud *cloud, const sph_real *row, const sph_scalars *diagonal,
                                 unsigned char *monotone)
{
    if (!cloud) return missing("cloud");
    return sph_rows_monotone(*cloud, row, GIVEN(sph_scalars, diagonal), monotone);
}

sph_index sph_shim_rows_time_step(const sph_cloud *cloud, const sph_real *row, sph_real *dt)
{
    if (!cloud) return missing("cloud");
    return sph_rows_time_step(*cloud, row, dt);
}

#define SWEEP(D) \
    sph_rows_growth(D, *cloud, row, tau, GIVEN(sph_vec, wave), re, im)
sph_index sph_shim_rows_growth(int dim, const sph_cloud *cloud, const sph_real *row, sph_real tau,
                               const sph_vec *wave, sph_real *re, sph_real *im)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP

int64_t sph_shim_csr_size(const sph_cloud *cloud)
{
    if (!cloud) return missing("cloud");
    return sph_csr_size(*cloud);
}

sph_index sph_shim_csr_assemble(const sph_cloud *cloud, const sph_real *row, const sph_scalars *diagonal,
                                int drop_zeros, const sph_csr *out, int64_t *entries)
{
    if (!cloud) return missing("cloud");
    return sph_csr_assemble(*cloud, row, GIVEN(sph_scalars, diagonal), drop_zeros, GIVEN(sph_csr, out),
                            entries);
}
sph_real sph_shim_signal_speed(sph_real c_i, sph_real c_j, sph_real beta_w)
{
    return sph_signal_speed(c_i, c_j, beta_w);
}
sph_real sph_shim_viscosity_signal(sph_real alpha_speed, sph_real w, sph_real per_rho)
{
    return sph_viscosity_signal(alpha_speed, w, per_rho);
}
sph_real sph_shim_kernel_f_apart(int kernel, int dim, sph_real r, sph_real h)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_kernel_f_apart((sph_kernel)kernel, dim, r, h);
}
sph_real sph_shim_time_step_sound(sph_real h, sph_real c, sph_real speed)
{
    return sph_time_step_sound(h, c, speed);
}
sph_real sph_shim_time_step_force(sph_real h, sph_real acceleration)
{
    return sph_time_step_force(h, acceleration);
}
sph_real sph_shim_time_step_viscous_nu(sph_real h, sph_real nu)
{
    return sph_time_step_viscous_nu(h, nu);
}

#define SWEEP(K, D) \
    sph_density_number(K, D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_scalar_out, out))
sph_index sph_shim_density_number(int kernel, int dim, const sph_cloud *cloud, const sph_scalars *m,
                                  const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_fluid_rates_monaghan(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_fluid_out, out))
FLATTEN static sph_index folded_fluid_rates_monaghan(int kernel, int dim, const sph_cloud *cloud,
                                                     const sph_fluid *fluid, const sph_fluid_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    CONSTANT_KERNEL_AND_DIM
    return answer;
}
sph_index sph_shim_fluid_rates_monaghan(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                        const sph_fluid_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    if (IS_CONSTANT(kernel)) return folded_fluid_rates_monaghan(kernel, dim, cloud, fluid, out);
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_fluid_rates_colagrossi(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_fluid_out, out))
sph_index sph_shim_fluid_rates_colagrossi(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                          const sph_fluid_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_fluid_rates_hu_adams(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_fluid_out, out))
sph_index sph_shim_fluid_rates_hu_adams(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                        const sph_fluid_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_viscosity_mu_morris(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_scalars, mu), \
                            GIVEN(sph_vector_out, acceleration))
sph_index sph_shim_viscosity_mu_morris(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                       const sph_scalars *mu, const sph_vector_out *acceleration)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_viscosity_mu_monaghan_cleary(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_scalars, mu), \
                                     GIVEN(sph_vector_out, acceleration))
sph_index sph_shim_viscosity_mu_monaghan_cleary(int kernel, int dim, const sph_cloud *cloud,
                                                const sph_fluid *fluid, const sph_scalars *mu,
                                                const sph_vector_out *acceleration)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_viscosity_mu_espanol_revenga(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_shear_bulk, mu), \
                                     GIVEN(sph_vector_out, acceleration))
sph_index sph_shim_viscosity_mu_espanol_revenga(int kernel, int dim, const sph_cloud *cloud,
                                                const sph_fluid *fluid, const sph_shear_bulk *mu,
                                                const sph_vector_out *acceleration)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_velocity_xsph(K, D, *cloud, GIVEN(sph_fluid, fluid), epsilon, GIVEN(sph_vector_out, change))
sph_index sph_shim_velocity_xsph(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                 sph_real epsilon, const sph_vector_out *change)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_wall_adami(K, D, *cloud, GIVEN(sph_wall, wall), GIVEN(sph_wall_out, out))
sph_index sph_shim_wall_adami(int kernel, int dim, const sph_cloud *cloud, const sph_wall *wall,
                              const sph_wall_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_wall_rows_adami(K, D, *cloud, GIVEN(sph_wall, wall), GIVEN(sph_rows_out, out), \
                        GIVEN(sph_scalar_out, source))
sph_index sph_shim_wall_rows_adami(int kernel, int dim, const sph_cloud *cloud, const sph_wall *wall,
                                   const sph_rows_out *out, const sph_scalar_out *source)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_wall_rows_eliminate(D, *cloud, GIVEN(sph_wall, wall), GIVEN(sph_rows_out, rows), \
                            GIVEN(sph_scalar_out, source))
sph_index sph_shim_wall_rows_eliminate(int dim, const sph_cloud *cloud, const sph_wall *wall,
                                       const sph_rows_out *rows, const sph_scalar_out *source)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_density_diffusion_weight(sph_real V_j, sph_real strength, sph_real f_ij)
{
    return sph_density_diffusion_weight(V_j, strength, f_ij);
}
sph_real sph_shim_time_step_density_diffusion(int kernel, int dim, sph_real h, sph_real delta, sph_real c)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_time_step_density_diffusion((sph_kernel)kernel, dim, h, delta, c);
}

#define SWEEP(K, D) \
    sph_density_diffusion_molteni(K, D, *cloud, GIVEN(sph_diffusion, diffusion), GIVEN(sph_scalar_out, out))
sph_index sph_shim_density_diffusion_molteni(int kernel, int dim, const sph_cloud *cloud,
                                             const sph_diffusion *diffusion, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_density_diffusion_antuono(K, D, *cloud, GIVEN(sph_diffusion, diffusion), GIVEN(sph_scalar_out, out))
sph_index sph_shim_density_diffusion_antuono(int kernel, int dim, const sph_cloud *cloud,
                                             const sph_diffusion *diffusion, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_density_diffusion_fourtakas(K, D, *cloud, GIVEN(sph_diffusion, diffusion), \
                                    GIVEN(sph_scalar_out, out))
sph_index sph_shim_density_diffusion_fourtakas(int kernel, int dim, const sph_cloud *cloud,
                                               const sph_diffusion *diffusion, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_density_diffusion_rows_molteni(K, D, *cloud, GIVEN(sph_diffusion, diffusion), \
                                       GIVEN(sph_rows_out, out))
sph_index sph_shim_density_diffusion_rows_molteni(int kernel, int dim, const sph_cloud *cloud,
                                                  const sph_diffusion *diffusion, const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_free_surface(K, D, *cloud, GIVEN(sph_surface_out, out))
sph_index sph_shim_free_surface(int kernel, int dim, const sph_cloud *cloud, const sph_surface_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_free_surface_cone(D, *cloud, GIVEN(sph_scalars, eigenvalue), GIVEN(sph_vectors, normal), flag)
sph_index sph_shim_free_surface_cone(int dim, const sph_cloud *cloud, const sph_scalars *eigenvalue,
                                     const sph_vectors *normal, unsigned char *flag)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_shift_strength_skillen(sph_real factor, sph_real h, sph_real path)
{
    return sph_shift_strength_skillen(factor, h, path);
}
sph_real sph_shim_shift_strength_sun(sph_real h, sph_real path, sph_real length)
{
    return sph_shift_strength_sun(h, path, length);
}

#define SWEEP(K, D) \
    sph_shift_displacement(K, D, *cloud, GIVEN(sph_shift, shift), GIVEN(sph_vector_out, out))
sph_index sph_shim_shift_displacement(int kernel, int dim, const sph_cloud *cloud, const sph_shift *shift,
                                      const sph_vector_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_shift_rates(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_vectors, shift), \
                    GIVEN(sph_fluid_out, out))
sph_index sph_shim_shift_rates(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                               const sph_vectors *shift, const sph_fluid_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_transport_adami(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_vectors, transport), background, \
                        GIVEN(sph_transport_out, out))
sph_index sph_shim_transport_adami(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                   const sph_vectors *transport, sph_real background,
                                   const sph_transport_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_pressure_factor_dfsph(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_scalars, moves), \
                              GIVEN(sph_scalar_out, out))
sph_index sph_shim_pressure_factor_dfsph(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                         const sph_scalars *moves, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_fluid_rates_riemann(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_riemann_options, options), \
                            GIVEN(sph_fluid_out, out))
sph_index sph_shim_fluid_rates_riemann(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                       const sph_riemann_options *options, const sph_fluid_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_tension_css(K, D, *cloud, GIVEN(sph_tension, tension), GIVEN(sph_vector_out, acceleration))
sph_index sph_shim_tension_css(int kernel, int dim, const sph_cloud *cloud, const sph_tension *tension,
                               const sph_vector_out *acceleration)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_tension_csf(K, D, *cloud, GIVEN(sph_tension, tension), GIVEN(sph_tension_out, out))
sph_index sph_shim_tension_csf(int kernel, int dim, const sph_cloud *cloud, const sph_tension *tension,
                               const sph_tension_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_wall_gamma(K, D, *cloud, GIVEN(sph_wall_elements, elements), GIVEN(sph_wall_gamma_out, out))
sph_index sph_shim_wall_gamma(int kernel, int dim, const sph_cloud *cloud, const sph_wall_elements *elements,
                              const sph_wall_gamma_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_wall_gradient(K, D, *cloud, GIVEN(sph_wall_terms, wall), GIVEN(sph_scalars, f), \
                      GIVEN(sph_vector_out, out))
sph_index sph_shim_wall_gradient(int kernel, int dim, const sph_cloud *cloud, const sph_wall_terms *wall,
                                 const sph_scalars *f, const sph_vector_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_wall_gradient_rows(K, D, *cloud, GIVEN(sph_wall_terms, wall), GIVEN(sph_gradient_rows_out, out), \
                           GIVEN(sph_vector_out, source))
sph_index sph_shim_wall_gradient_rows(int kernel, int dim, const sph_cloud *cloud, const sph_wall_terms *wall,
                                      const sph_gradient_rows_out *out, const sph_vector_out *source)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_wall_laplacian(K, D, *cloud, GIVEN(sph_wall_terms, wall), GIVEN(sph_scalars, f), \
                       GIVEN(sph_scalar_out, out))
sph_index sph_shim_wall_laplacian(int kernel, int dim, const sph_cloud *cloud, const sph_wall_terms *wall,
                                  const sph_scalars *f, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_wall_laplacian_rows(K, D, *cloud, GIVEN(sph_wall_terms, wall), GIVEN(sph_rows_out, out), \
                            GIVEN(sph_scalar_out, source))
sph_index sph_shim_wall_laplacian_rows(int kernel, int dim, const sph_cloud *cloud,
                                       const sph_wall_terms *wall, const sph_rows_out *out,
                                       const sph_scalar_out *source)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_collision_sequential(D, *cloud, GIVEN(sph_collision, collision), GIVEN(sph_vector_out, velocity), \
                             out)
sph_index sph_shim_collision_sequential(int dim, const sph_cloud *cloud, const sph_collision *collision,
                                        const sph_vector_out *velocity, sph_collision_report *out)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_collision_count(D, *cloud, GIVEN(sph_collision, collision), GIVEN(sph_vectors, v), count)
sph_index sph_shim_collision_count(int dim, const sph_cloud *cloud, const sph_collision *collision,
                                   const sph_vectors *v, sph_index *count)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_collision_change_weighted(D, *cloud, GIVEN(sph_collision, collision), GIVEN(sph_vectors, v), count, \
                                  GIVEN(sph_vector_out, change))
sph_index sph_shim_collision_change_weighted(int dim, const sph_cloud *cloud, const sph_collision *collision,
                                             const sph_vectors *v, const sph_index *count,
                                             const sph_vector_out *change)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_conductivity_speed(sph_real P_i, sph_real P_j, sph_real per_rho)
{
    return sph_conductivity_speed(P_i, P_j, per_rho);
}
sph_real sph_shim_shock_pair(sph_real m_j, sph_real div_j, sph_real w_ij)
{
    return sph_shock_pair(m_j, div_j, w_ij);
}
sph_real sph_shim_shock_value(sph_real sum, sph_real rho)
{
    return sph_shock_value(sum, rho);
}

#define SWEEP(K, D) \
    sph_gas_rates(K, D, *cloud, GIVEN(sph_gas, state), GIVEN(sph_gas_out, out))
sph_index sph_shim_gas_rates(int kernel, int dim, const sph_cloud *cloud, const sph_gas *state,
                             const sph_gas_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_velocity_gradient_difference(K, D, *cloud, GIVEN(sph_medium, medium), GIVEN(sph_vectors, v), \
                                     GIVEN(sph_velocity_gradient_out, out))
sph_index sph_shim_velocity_gradient_difference(int kernel, int dim, const sph_cloud *cloud,
                                                const sph_medium *medium, const sph_vectors *v,
                                                const sph_velocity_gradient_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_velocity_gradient_cspm(K, D, *cloud, GIVEN(sph_vectors, v), GIVEN(sph_velocity_gradient_out, out))
sph_index sph_shim_velocity_gradient_cspm(int kernel, int dim, const sph_cloud *cloud, const sph_vectors *v,
                                          const sph_velocity_gradient_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_shock_indicator(K, D, *cloud, GIVEN(sph_gas, state), GIVEN(sph_scalars, div_v), \
                        GIVEN(sph_shock_out, out))
sph_index sph_shim_shock_indicator(int kernel, int dim, const sph_cloud *cloud, const sph_gas *state,
                                   const sph_scalars *div_v, const sph_shock_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_cleaning_sigma(int dim)
{
    if (dim < 1 || dim > 3) return SPH_R(0);
    return sph_cleaning_sigma(dim);
}
sph_real sph_shim_resistivity_switch(sph_real h, sph_real change, sph_real strength)
{
    return sph_resistivity_switch(h, change, strength);
}
sph_real sph_shim_resistivity_pair(sph_real weight, sph_real alpha_speed, sph_real per_rho)
{
    return sph_resistivity_pair(weight, alpha_speed, per_rho);
}
sph_real sph_shim_time_step_resistivity(sph_real h, sph_real eta)
{
    return sph_time_step_resistivity(h, eta);
}

#define SWEEP(K, D) \
    sph_divergence_difference(K, D, *cloud, GIVEN(sph_medium, medium), GIVEN(sph_vectors, field), \
                              GIVEN(sph_scalar_out, out))
sph_index sph_shim_divergence_difference(int kernel, int dim, const sph_cloud *cloud,
                                         const sph_medium *medium, const sph_vectors *field,
                                         const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_divergence_symmetric(K, D, *cloud, GIVEN(sph_medium, medium), GIVEN(sph_vectors, field), \
                             GIVEN(sph_scalar_out, out))
sph_index sph_shim_divergence_symmetric(int kernel, int dim, const sph_cloud *cloud, const sph_medium *medium,
                                        const sph_vectors *field, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_symmetric(K, D, *cloud, GIVEN(sph_medium, medium), GIVEN(sph_scalars, f), \
                           GIVEN(sph_vector_out, out))
sph_index sph_shim_gradient_symmetric(int kernel, int dim, const sph_cloud *cloud, const sph_medium *medium,
                                      const sph_scalars *f, const sph_vector_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_curl_difference(K, D, *cloud, GIVEN(sph_medium, medium), GIVEN(sph_vectors, field), \
                        GIVEN(sph_vector_out, out))
sph_index sph_shim_curl_difference(int kernel, int dim, const sph_cloud *cloud, const sph_medium *medium,
                                   const sph_vectors *field, const sph_vector_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_cleaning_rates(K, D, *cloud, GIVEN(sph_cleaning, state), GIVEN(sph_cleaning_out, out))
sph_index sph_shim_cleaning_rates(int kernel, int dim, const sph_cloud *cloud, const sph_cleaning *state,
                                  const sph_cleaning_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_resistivity_ohmic(K, D, *cloud, GIVEN(sph_ohmic, state), GIVEN(sph_ohmic_out, out))
sph_index sph_shim_resistivity_ohmic(int kernel, int dim, const sph_cloud *cloud, const sph_ohmic *state,
                                     const sph_ohmic_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_mhd_rates(K, D, *cloud, GIVEN(sph_mhd, state), GIVEN(sph_mhd_out, out))
sph_index sph_shim_mhd_rates(int kernel, int dim, const sph_cloud *cloud, const sph_mhd *state,
                             const sph_mhd_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_rk_correction(K, D, *cloud, GIVEN(sph_rk_out, out))
sph_index sph_shim_rk_correction(int kernel, int dim, const sph_cloud *cloud, const sph_rk_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_interpolate_rk(K, D, *cloud, GIVEN(sph_rk, rk), GIVEN(sph_scalars, f), GIVEN(sph_scalar_out, out))
sph_index sph_shim_interpolate_rk(int kernel, int dim, const sph_cloud *cloud, const sph_rk *rk,
                                  const sph_scalars *f, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_interpolate_rows_rk(K, D, *cloud, GIVEN(sph_rk, rk), GIVEN(sph_rows_out, out))
sph_index sph_shim_interpolate_rows_rk(int kernel, int dim, const sph_cloud *cloud, const sph_rk *rk,
                                       const sph_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_rk(K, D, *cloud, GIVEN(sph_rk, rk), GIVEN(sph_scalars, f), GIVEN(sph_vector_out, out))
sph_index sph_shim_gradient_rk(int kernel, int dim, const sph_cloud *cloud, const sph_rk *rk,
                               const sph_scalars *f, const sph_vector_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gradient_rows_rk(K, D, *cloud, GIVEN(sph_rk, rk), GIVEN(sph_gradient_rows_out, out))
sph_index sph_shim_gradient_rows_rk(int kernel, int dim, const sph_cloud *cloud, const sph_rk *rk,
                                    const sph_gradient_rows_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gas_rates_crk(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_rk, rk), \
                      GIVEN(sph_corrected_out, out))
sph_index sph_shim_gas_rates_crk(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                 const sph_rk *rk, const sph_corrected_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_gas_rates_iad(K, D, *cloud, GIVEN(sph_fluid, fluid), GIVEN(sph_matrices, inverse), \
                      GIVEN(sph_corrected_out, out))
sph_index sph_shim_gas_rates_iad(int kernel, int dim, const sph_cloud *cloud, const sph_fluid *fluid,
                                 const sph_matrices *inverse, const sph_corrected_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP
sph_real sph_shim_gravity_pair(int kernel, sph_real r, sph_real h_i, sph_real h_j)
{
    return sph_gravity_pair((sph_kernel)kernel, r, h_i, h_j);
}
sph_real sph_shim_gravity_zeta_value(sph_real h, sph_real rho, sph_real sum)
{
    return sph_gravity_zeta_value(h, rho, sum);
}

#define SWEEP(K) \
    sph_gravity_direct(K, *cloud, GIVEN(sph_scalars, m), newton, GIVEN(sph_vector_out, acceleration), \
                       GIVEN(sph_scalar_out, potential))
sph_index sph_shim_gravity_direct(int kernel, const sph_cloud *cloud, const sph_scalars *m, sph_real newton,
                                  const sph_vector_out *acceleration, const sph_scalar_out *potential)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL
    return answer;
}
#undef SWEEP

#define SWEEP(K) \
    sph_gravity_zeta(K, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_scalars, rho), GIVEN(sph_scalar_out, out))
sph_index sph_shim_gravity_zeta(int kernel, const sph_cloud *cloud, const sph_scalars *m,
                                const sph_scalars *rho, const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL
    return answer;
}
#undef SWEEP

#define SWEEP(K) \
    sph_gravity_correction(K, *cloud, GIVEN(sph_medium, medium), GIVEN(sph_scalars, zeta), newton, \
                           GIVEN(sph_vector_out, acceleration))
sph_index sph_shim_gravity_correction(int kernel, const sph_cloud *cloud, const sph_medium *medium,
                                      const sph_scalars *zeta, sph_real newton,
                                      const sph_vector_out *acceleration)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_deformation_gradient(K, D, *cloud, *x, GIVEN(sph_matrices, inverse), GIVEN(sph_matrix_out, out))
sph_index sph_shim_deformation_gradient(int kernel, int dim, const sph_cloud *cloud, const sph_points *x,
                                        const sph_matrices *inverse, const sph_matrix_out *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    if (!x) return missing("x");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_solid_acceleration(K, D, *cloud, GIVEN(sph_solid, solid), GIVEN(sph_vector_out, acceleration))
sph_index sph_shim_solid_acceleration(int kernel, int dim, const sph_cloud *cloud, const sph_solid *solid,
                                      const sph_vector_out *acceleration)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_nearest_distance(D, *targets_of, *sources, GIVEN(sph_scalar_out, out))
sph_index sph_shim_nearest_distance(int dim, const sph_cloud *targets_of, const sph_points *sources,
                                    const sph_scalar_out *out)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!targets_of) return missing("targets_of");
    if (!sources) return missing("sources");
    EVERY_DIM
    return answer;
}
#undef SWEEP

sph_index sph_shim_hexatic_order(const sph_cloud *cloud, const sph_scalar_out *out)
{
    if (!cloud) return missing("cloud");
    return sph_hexatic_order(*cloud, GIVEN(sph_scalar_out, out));
}

#define SWEEP(D) \
    sph_radial_distribution(D, *cloud, farthest, number_density, bins, g)
sph_index sph_shim_radial_distribution(int dim, const sph_cloud *cloud, sph_real farthest,
                                       sph_real number_density, int bins, sph_real *g)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_coincident_count(D, *cloud, distance)
sph_index sph_shim_coincident_count(int dim, const sph_cloud *cloud, sph_real distance)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_coincident_separate(D, *cloud, within, distance, GIVEN(sph_vector_out, position))
sph_index sph_shim_coincident_separate(int dim, const sph_cloud *cloud, sph_real within, sph_real distance,
                                       const sph_vector_out *position)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_conserved_sums(D, *cloud, GIVEN(sph_scalars, m), GIVEN(sph_vectors, v), out)
sph_index sph_shim_conserved_sums(int dim, const sph_cloud *cloud, const sph_scalars *m, const sph_vectors *v,
                                  sph_conserved *out)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!cloud) return missing("cloud");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(K, D) \
    sph_cloud_examine(K, D, *cloud, both_sides, samples, out)
sph_index sph_shim_cloud_examine(int kernel, int dim, const sph_cloud *cloud, int both_sides,
                                 sph_index samples, sph_findings *out)
{
    sph_index answer = SPH_ERROR_KERNEL;
    if (!cloud) return missing("cloud");
    EVERY_KERNEL_AND_DIM
    return answer;
}
#undef SWEEP
const char *sph_shim_finding_text(int finding)
{
    return sph_finding_text(finding);
}
sph_real sph_shim_grid_pair_radius(int criterion, sph_real R_i, sph_real R_j)
{
    return sph_grid_pair_radius(criterion, R_i, R_j);
}
sph_real sph_shim_grid_wrap(sph_real x, sph_real low, sph_real length)
{
    return sph_grid_wrap(x, low, length);
}
size_t sph_shim_grid_workspace(int dim, sph_index n)
{
    return sph_grid_workspace(dim, n);
}

#define SWEEP(D) \
    sph_grid_build(D, *sources, GIVEN(sph_scalars, radius), work, work_size, grid)
sph_index sph_shim_grid_build(int dim, const sph_points *sources, const sph_scalars *radius, void *work,
                              size_t work_size, sph_grid *grid)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!sources) return missing("sources");
    EVERY_DIM
    return answer;
}
#undef SWEEP

const sph_index *sph_shim_grid_permutation(const sph_grid *grid)
{
    return sph_grid_permutation(grid);
}

sph_index sph_shim_grid_permutation_own(const sph_grid *grid, sph_index n, sph_index *permutation)
{
    return sph_grid_permutation_own(grid, n, permutation);
}

sph_index sph_shim_grid_renumber_own(sph_grid *grid, sph_index n)
{
    return sph_grid_renumber_own(grid, n);
}

sph_index sph_shim_grid_renumber(sph_grid *grid)
{
    return sph_grid_renumber(grid);
}

#define SWEEP(D) \
    sph_grid_lists(D, grid, *query, start, index, capacity, pairs)
sph_index sph_shim_grid_lists(int dim, const sph_grid *grid, const sph_query *query, sph_index *start,
                              sph_index *index, int64_t capacity, int64_t *pairs)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!query) return missing("query");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_grid_count(D, grid, *query, start, pairs)
sph_index sph_shim_grid_count(int dim, const sph_grid *grid, const sph_query *query, sph_index *start,
                              int64_t *pairs)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!query) return missing("query");
    EVERY_DIM
    return answer;
}
#undef SWEEP
size_t sph_shim_search_size(int dim, sph_index n, int64_t pairs)
{
    return sph_search_size(dim, n, pairs);
}

#define SWEEP(D) \
    sph_search(D, *points, GIVEN(sph_scalars, radius), criterion, memory, size, found)
sph_index sph_shim_search(int dim, const sph_points *points, const sph_scalars *radius, int criterion,
                          void *memory, size_t size, sph_neighbors *found)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!points) return missing("points");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_part_of(D, *points, GIVEN(sph_scalars, radius), part)
sph_index sph_shim_part_of(int dim, const sph_points *points, const sph_scalars *radius, sph_part *part)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!points) return missing("points");
    EVERY_DIM
    return answer;
}
#undef SWEEP

#define SWEEP(D) \
    sph_select_near(D, *points, GIVEN(sph_scalars, radius), criterion, GIVEN(sph_part, part), chosen, count)
sph_index sph_shim_select_near(int dim, const sph_points *points, const sph_scalars *radius, int criterion,
                               const sph_part *part, sph_index *chosen, int64_t *count)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!points) return missing("points");
    EVERY_DIM
    return answer;
}
#undef SWEEP

sph_index sph_shim_list_prune(sph_index n, sph_index n_total, const sph_index *start, sph_index *index,
                              sph_index *kept, int64_t *count)
{
    return sph_list_prune(n, n_total, start, index, kept, count);
}

sph_index sph_shim_list_sort(sph_index n, sph_index n_total, const sph_index *start, sph_index *index,
                             const int64_t *key)
{
    return sph_list_sort(n, n_total, start, index, key);
}

sph_index sph_shim_permute(sph_index n, const sph_index *permutation, const sph_real *in, size_t stride,
                           sph_real *out)
{
    return sph_permute(n, permutation, in, stride, out);
}

sph_index sph_shim_permute_inverse(sph_index n, const sph_index *permutation, sph_index *inverse)
{
    return sph_permute_inverse(n, permutation, inverse);
}

#define SWEEP(D) \
    sph_rebuild_due(D, *now, *then, skin)
int sph_shim_rebuild_due(int dim, const sph_points *now, const sph_points *then, sph_real skin)
{
    sph_index answer = SPH_ERROR_DIM;
    if (!now) return missing("now");
    if (!then) return missing("then");
    EVERY_DIM
    return answer;
}
#undef SWEEP

size_t sph_shim_struct_size(const char *name)
{
    if (!name) return 0;
    if (!strcmp(name, "sph_vec")) return sizeof(sph_vec);
    if (!strcmp(name, "sph_sym")) return sizeof(sph_sym);
    if (!strcmp(name, "sph_points")) return sizeof(sph_points);
    if (!strcmp(name, "sph_scalars")) return sizeof(sph_scalars);
    if (!strcmp(name, "sph_list")) return sizeof(sph_list);
    if (!strcmp(name, "sph_vectors")) return sizeof(sph_vectors);
    if (!strcmp(name, "sph_vector_out")) return sizeof(sph_vector_out);
    if (!strcmp(name, "sph_scalar_out")) return sizeof(sph_scalar_out);
    if (!strcmp(name, "sph_matrices")) return sizeof(sph_matrices);
    if (!strcmp(name, "sph_matrix_out")) return sizeof(sph_matrix_out);
    if (!strcmp(name, "sph_cloud")) return sizeof(sph_cloud);
    if (!strcmp(name, "sph_derivatives_out")) return sizeof(sph_derivatives_out);
    if (!strcmp(name, "sph_rows_out")) return sizeof(sph_rows_out);
    if (!strcmp(name, "sph_correction_out")) return sizeof(sph_correction_out);
    if (!strcmp(name, "sph_gradient_rows_out")) return sizeof(sph_gradient_rows_out);
    if (!strcmp(name, "sph_density_options")) return sizeof(sph_density_options);
    if (!strcmp(name, "sph_density_out")) return sizeof(sph_density_out);
    if (!strcmp(name, "sph_jet")) return sizeof(sph_jet);
    if (!strcmp(name, "sph_derivatives_options")) return sizeof(sph_derivatives_options);
    if (!strcmp(name, "sph_sources")) return sizeof(sph_sources);
    if (!strcmp(name, "sph_interpolation_options")) return sizeof(sph_interpolation_options);
    if (!strcmp(name, "sph_interpolation_out")) return sizeof(sph_interpolation_out);
    if (!strcmp(name, "sph_interpolation_rows_out")) return sizeof(sph_interpolation_rows_out);
    if (!strcmp(name, "sph_elliptic_options")) return sizeof(sph_elliptic_options);
    if (!strcmp(name, "sph_elliptic_report")) return sizeof(sph_elliptic_report);
    if (!strcmp(name, "sph_diagonal")) return sizeof(sph_diagonal);
    if (!strcmp(name, "sph_boundary")) return sizeof(sph_boundary);
    if (!strcmp(name, "sph_csr")) return sizeof(sph_csr);
    if (!strcmp(name, "sph_tait")) return sizeof(sph_tait);
    if (!strcmp(name, "sph_fluid")) return sizeof(sph_fluid);
    if (!strcmp(name, "sph_fluid_out")) return sizeof(sph_fluid_out);
    if (!strcmp(name, "sph_shear_bulk")) return sizeof(sph_shear_bulk);
    if (!strcmp(name, "sph_wall")) return sizeof(sph_wall);
    if (!strcmp(name, "sph_wall_out")) return sizeof(sph_wall_out);
    if (!strcmp(name, "sph_diffusion")) return sizeof(sph_diffusion);
    if (!strcmp(name, "sph_surface_out")) return sizeof(sph_surface_out);
    if (!strcmp(name, "sph_shift")) return sizeof(sph_shift);
    if (!strcmp(name, "sph_transport_out")) return sizeof(sph_transport_out);
    if (!strcmp(name, "sph_riemann_options")) return sizeof(sph_riemann_options);
    if (!strcmp(name, "sph_tension")) return sizeof(sph_tension);
    if (!strcmp(name, "sph_tension_out")) return sizeof(sph_tension_out);
    if (!strcmp(name, "sph_wall_elements")) return sizeof(sph_wall_elements);
    if (!strcmp(name, "sph_wall_gamma_out")) return sizeof(sph_wall_gamma_out);
    if (!strcmp(name, "sph_wall_terms")) return sizeof(sph_wall_terms);
    if (!strcmp(name, "sph_collision")) return sizeof(sph_collision);
    if (!strcmp(name, "sph_collision_report")) return sizeof(sph_collision_report);
    if (!strcmp(name, "sph_medium")) return sizeof(sph_medium);
    if (!strcmp(name, "sph_gas")) return sizeof(sph_gas);
    if (!strcmp(name, "sph_gas_out")) return sizeof(sph_gas_out);
    if (!strcmp(name, "sph_velocity_gradient_out")) return sizeof(sph_velocity_gradient_out);
    if (!strcmp(name, "sph_shock_out")) return sizeof(sph_shock_out);
    if (!strcmp(name, "sph_cleaning")) return sizeof(sph_cleaning);
    if (!strcmp(name, "sph_cleaning_out")) return sizeof(sph_cleaning_out);
    if (!strcmp(name, "sph_ohmic")) return sizeof(sph_ohmic);
    if (!strcmp(name, "sph_ohmic_out")) return sizeof(sph_ohmic_out);
    if (!strcmp(name, "sph_mhd")) return sizeof(sph_mhd);
    if (!strcmp(name, "sph_mhd_out")) return sizeof(sph_mhd_out);
    if (!strcmp(name, "sph_rk")) return sizeof(sph_rk);
    if (!strcmp(name, "sph_rk_out")) return sizeof(sph_rk_out);
    if (!strcmp(name, "sph_corrected_out")) return sizeof(sph_corrected_out);
    if (!strcmp(name, "sph_solid")) return sizeof(sph_solid);
    if (!strcmp(name, "sph_conserved")) return sizeof(sph_conserved);
    if (!strcmp(name, "sph_offender")) return sizeof(sph_offender);
    if (!strcmp(name, "sph_findings")) return sizeof(sph_findings);
    if (!strcmp(name, "sph_grid")) return sizeof(sph_grid);
    if (!strcmp(name, "sph_query")) return sizeof(sph_query);
    if (!strcmp(name, "sph_neighbors")) return sizeof(sph_neighbors);
    if (!strcmp(name, "sph_part")) return sizeof(sph_part);
    return 0;
}
