/* SPDX-License-Identifier: MIT
 *
 * sph_shim_sweeps.h - part of sph_shim.h, which says how to call these: one exported symbol for each
 * operator of the headers. Written by examples/hosts/generate.py from the headers: run it again instead
 * of changing this file. */

/* texts */
SPH_SHIM_EXPORT const char *sph_shim_kernel_name(int kernel);
SPH_SHIM_EXPORT int sph_shim_kernel_from_name(const char *name);
SPH_SHIM_EXPORT const char *sph_shim_status_text(int status);
SPH_SHIM_EXPORT const char *sph_shim_finding_text(int finding);

/* numbers */
SPH_SHIM_EXPORT sph_real sph_shim_kernel_support_ratio(int kernel);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_h_over_dx(int kernel);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_h_from_support(int kernel, sph_real support);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_support(int kernel, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_sigma(int kernel, int dim);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_shape(int kernel, int dim, sph_real q);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_shape_f(int kernel, int dim, sph_real q);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_shape_d2(int kernel, int dim, sph_real q);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_w(int kernel, int dim, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_f(int kernel, int dim, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_dwdr(int kernel, int dim, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_d2wdr2(int kernel, int dim, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_dwdh(int kernel, int dim, sph_real r, sph_real h);
SPH_SHIM_EXPORT int sph_shim_kernel_has_cusp(int kernel);
SPH_SHIM_EXPORT int sph_shim_kernel_may_convexify(int kernel, int dim);
SPH_SHIM_EXPORT sph_real sph_shim_cohesion_kernel_akinci(sph_real r, sph_real support);
SPH_SHIM_EXPORT sph_real sph_shim_adhesion_kernel_akinci(sph_real r, sph_real support);
SPH_SHIM_EXPORT int sph_shim_kernel_has_gravity(int kernel);
SPH_SHIM_EXPORT sph_real sph_shim_gravity_shape_f(int kernel, sph_real q);
SPH_SHIM_EXPORT sph_real sph_shim_gravity_shape(int kernel, sph_real q);
SPH_SHIM_EXPORT sph_real sph_shim_gravity_potential(int kernel, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_gravity_force(int kernel, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_gravity_dphidh(int kernel, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_laplacian_weight_brookshaw(int kernel, int dim, sph_real r, sph_real h,
                                                             sph_real V_j);
SPH_SHIM_EXPORT sph_real sph_shim_moment_weight_gradient(int kernel, int dim, sph_real r, sph_real h,
                                                         sph_real V_j);
SPH_SHIM_EXPORT sph_real sph_shim_moment_weight_iad(int kernel, int dim, sph_real r, sph_real h,
                                                    sph_real V_j);
SPH_SHIM_EXPORT sph_real sph_shim_boundary_weight_bim(int kernel, sph_real e, sph_real normal, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_mobility_pair(int mean, sph_real m_i, sph_real m_j, sph_real upstream);
SPH_SHIM_EXPORT sph_real sph_shim_signal_speed(sph_real c_i, sph_real c_j, sph_real beta_w);
SPH_SHIM_EXPORT sph_real sph_shim_viscosity_signal(sph_real alpha_speed, sph_real w, sph_real per_rho);
SPH_SHIM_EXPORT sph_real sph_shim_kernel_f_apart(int kernel, int dim, sph_real r, sph_real h);
SPH_SHIM_EXPORT sph_real sph_shim_time_step_sound(sph_real h, sph_real c, sph_real speed);
SPH_SHIM_EXPORT sph_real sph_shim_time_step_force(sph_real h, sph_real acceleration);
SPH_SHIM_EXPORT sph_real sph_shim_time_step_viscous_nu(sph_real h, sph_real nu);
SPH_SHIM_EXPORT sph_real sph_shim_density_diffusion_weight(sph_real V_j, sph_real strength, sph_real f_ij);
SPH_SHIM_EXPORT sph_real sph_shim_time_step_density_diffusion(int kernel, int dim, sph_real h, sph_real delta,
                                                              sph_real c);
SPH_SHIM_EXPORT sph_real sph_shim_shift_strength_skillen(sph_real factor, sph_real h, sph_real path);
SPH_SHIM_EXPORT sph_real sph_shim_shift_strength_sun(sph_real h, sph_real path, sph_real length);
SPH_SHIM_EXPORT sph_real sph_shim_conductivity_speed(sph_real P_i, sph_real P_j, sph_real per_rho);
SPH_SHIM_EXPORT sph_real sph_shim_shock_pair(sph_real m_j, sph_real div_j, sph_real w_ij);
SPH_SHIM_EXPORT sph_real sph_shim_shock_value(sph_real sum, sph_real rho);
SPH_SHIM_EXPORT sph_real sph_shim_cleaning_sigma(int dim);
SPH_SHIM_EXPORT sph_real sph_shim_resistivity_switch(sph_real h, sph_real change, sph_real strength);
SPH_SHIM_EXPORT sph_real sph_shim_resistivity_pair(sph_real weight, sph_real alpha_speed, sph_real per_rho);
SPH_SHIM_EXPORT sph_real sph_shim_time_step_resistivity(sph_real h, sph_real eta);
SPH_SHIM_EXPORT sph_real sph_shim_gravity_pair(int kernel, sph_real r, sph_real h_i, sph_real h_j);
SPH_SHIM_EXPORT sph_real sph_shim_gravity_zeta_value(sph_real h, sph_real rho, sph_real sum);
SPH_SHIM_EXPORT sph_real sph_shim_grid_pair_radius(int criterion, sph_real R_i, sph_real R_j);
SPH_SHIM_EXPORT sph_real sph_shim_grid_wrap(sph_real x, sph_real low, sph_real length);
SPH_SHIM_EXPORT size_t sph_shim_grid_workspace(int dim, sph_index n);
SPH_SHIM_EXPORT size_t sph_shim_search_size(int dim, sph_index n, int64_t pairs);

/* operators, search and orders */
SPH_SHIM_EXPORT sph_index sph_shim_shepard_sum(int kernel, int dim, const sph_cloud *cloud,
                                               const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_interpolate_shepard(int kernel, int dim, const sph_cloud *cloud,
                                                       const sph_scalars *f, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_density_summation(int kernel, int dim, const sph_cloud *cloud,
                                                     const sph_scalars *m, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_density_adaptive(int kernel, int dim, const sph_cloud *cloud,
                                                    const sph_scalars *m, const sph_density_options *options,
                                                    const sph_density_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_difference(int kernel, int dim, const sph_cloud *cloud,
                                                       const sph_scalars *f, const sph_vector_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_cspm(int kernel, int dim, const sph_cloud *cloud,
                                                 const sph_scalars *f, const sph_derivatives_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_iad(int kernel, int dim, const sph_cloud *cloud,
                                                const sph_scalars *f, const sph_derivatives_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_rows_cspm(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_gradient_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_rows_iad(int kernel, int dim, const sph_cloud *cloud,
                                                     const sph_gradient_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_correction_cspm(int kernel, int dim, const sph_cloud *cloud,
                                                            const sph_correction_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_correction_iad(int kernel, int dim, const sph_cloud *cloud,
                                                           const sph_correction_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_laplacian_brookshaw(int kernel, int dim, const sph_cloud *cloud,
                                                       const sph_scalars *f, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_laplacian_rows_brookshaw(int kernel, int dim, const sph_cloud *cloud,
                                                            const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_cspm(int kernel, int dim, const sph_cloud *cloud,
                                                    const sph_scalars *f,
                                                    const sph_derivatives_options *options,
                                                    const sph_derivatives_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_icspm(int kernel, int dim, const sph_cloud *cloud,
                                                     const sph_scalars *f,
                                                     const sph_derivatives_options *options,
                                                     const sph_derivatives_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_fatehi_manzari(int kernel, int dim, const sph_cloud *cloud,
                                                              const sph_scalars *f,
                                                              const sph_derivatives_options *options,
                                                              const sph_derivatives_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_wls(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_scalars *f,
                                                   const sph_derivatives_options *options,
                                                   const sph_derivatives_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_rows_cspm(int kernel, int dim, const sph_cloud *cloud,
                                                         const sph_jet *d, const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_rows_icspm(int kernel, int dim, const sph_cloud *cloud,
                                                          const sph_jet *d, const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_rows_fatehi_manzari(int kernel, int dim,
                                                                   const sph_cloud *cloud, const sph_jet *d,
                                                                   const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_derivatives_rows_wls(int kernel, int dim, const sph_cloud *cloud,
                                                        const sph_jet *d, const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_second_derivative_bim(int kernel, const sph_cloud *cloud,
                                                         const sph_scalars *f, sph_index left,
                                                         sph_index right, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_second_derivative_rows_bim(int kernel, const sph_cloud *cloud,
                                                              sph_index left, sph_index right,
                                                              const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_interpolate_mls(int kernel, int dim, const sph_cloud *targets_of,
                                                   const sph_sources *sources, const sph_scalars *f,
                                                   const sph_interpolation_options *options,
                                                   const sph_interpolation_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_interpolate_liu(int kernel, int dim, const sph_cloud *targets_of,
                                                   const sph_sources *sources, const sph_scalars *f,
                                                   const sph_interpolation_options *options,
                                                   const sph_interpolation_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_interpolate_rows_mls(int kernel, int dim, const sph_cloud *targets_of,
                                                        const sph_sources *sources,
                                                        const sph_interpolation_options *options,
                                                        const sph_interpolation_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_interpolate_rows_liu(int kernel, int dim, const sph_cloud *targets_of,
                                                        const sph_sources *sources,
                                                        const sph_interpolation_options *options,
                                                        const sph_interpolation_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_brookshaw(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_scalars *m,
                                                      const sph_elliptic_options *options,
                                                      const sph_scalars *u, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_brookshaw_corrected(int kernel, int dim, const sph_cloud *cloud,
                                                                const sph_scalars *m,
                                                                const sph_elliptic_options *options,
                                                                const sph_scalars *u,
                                                                const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_schwaiger(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_scalars *m,
                                                      const sph_elliptic_options *options,
                                                      const sph_scalars *u, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_msph(int kernel, int dim, const sph_cloud *cloud,
                                                 const sph_scalars *m, const sph_elliptic_options *options,
                                                 const sph_scalars *u, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_basic_degiuli_ban(int kernel, int dim, const sph_cloud *cloud,
                                                              const sph_scalars *m,
                                                              const sph_elliptic_options *options,
                                                              const sph_scalars *u,
                                                              const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_brookshaw(int kernel, int dim, const sph_cloud *cloud,
                                                           const sph_scalars *m,
                                                           const sph_elliptic_options *options,
                                                           const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_brookshaw_corrected(int kernel, int dim,
                                                                     const sph_cloud *cloud,
                                                                     const sph_scalars *m,
                                                                     const sph_elliptic_options *options,
                                                                     const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_schwaiger(int kernel, int dim, const sph_cloud *cloud,
                                                           const sph_scalars *m,
                                                           const sph_elliptic_options *options,
                                                           const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_msph(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_scalars *m,
                                                      const sph_elliptic_options *options,
                                                      const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_basic_degiuli_ban(int kernel, int dim,
                                                                   const sph_cloud *cloud,
                                                                   const sph_scalars *m,
                                                                   const sph_elliptic_options *options,
                                                                   const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_diagnose(int kernel, int dim, const sph_cloud *cloud,
                                                     const sph_elliptic_options *options,
                                                     const sph_elliptic_report *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_anisotropic(int kernel, int dim, const sph_cloud *cloud,
                                                             const sph_diagonal *mobility,
                                                             const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_tensor(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_matrices *mobility, const sph_scalars *u,
                                                   const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_tensor(int kernel, int dim, const sph_cloud *cloud,
                                                        const sph_matrices *mobility,
                                                        const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_elliptic_rows_boundary(int kernel, int dim, const sph_cloud *cloud,
                                                          const sph_scalars *m,
                                                          const sph_elliptic_options *options,
                                                          const sph_boundary *boundary,
                                                          const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_rows_apply(const sph_cloud *cloud, const sph_real *row,
                                              const sph_scalars *diagonal, const sph_scalars *u,
                                              const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_rows_monotone(const sph_cloud *cloud, const sph_real *row,
                                                 const sph_scalars *diagonal, unsigned char *monotone);
SPH_SHIM_EXPORT sph_index sph_shim_rows_time_step(const sph_cloud *cloud, const sph_real *row, sph_real *dt);
SPH_SHIM_EXPORT sph_index sph_shim_rows_growth(int dim, const sph_cloud *cloud, const sph_real *row,
                                               sph_real tau, const sph_vec *wave, sph_real *re, sph_real *im);
SPH_SHIM_EXPORT int64_t sph_shim_csr_size(const sph_cloud *cloud);
SPH_SHIM_EXPORT sph_index sph_shim_csr_assemble(const sph_cloud *cloud, const sph_real *row,
                                                const sph_scalars *diagonal, int drop_zeros,
                                                const sph_csr *out, int64_t *entries);
SPH_SHIM_EXPORT sph_index sph_shim_density_number(int kernel, int dim, const sph_cloud *cloud,
                                                  const sph_scalars *m, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_fluid_rates_monaghan(int kernel, int dim, const sph_cloud *cloud,
                                                        const sph_fluid *fluid, const sph_fluid_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_fluid_rates_colagrossi(int kernel, int dim, const sph_cloud *cloud,
                                                          const sph_fluid *fluid, const sph_fluid_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_fluid_rates_hu_adams(int kernel, int dim, const sph_cloud *cloud,
                                                        const sph_fluid *fluid, const sph_fluid_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_viscosity_mu_morris(int kernel, int dim, const sph_cloud *cloud,
                                                       const sph_fluid *fluid, const sph_scalars *mu,
                                                       const sph_vector_out *acceleration);
SPH_SHIM_EXPORT sph_index sph_shim_viscosity_mu_monaghan_cleary(int kernel, int dim, const sph_cloud *cloud,
                                                                const sph_fluid *fluid, const sph_scalars *mu,
                                                                const sph_vector_out *acceleration);
SPH_SHIM_EXPORT sph_index sph_shim_viscosity_mu_espanol_revenga(int kernel, int dim, const sph_cloud *cloud,
                                                                const sph_fluid *fluid,
                                                                const sph_shear_bulk *mu,
                                                                const sph_vector_out *acceleration);
SPH_SHIM_EXPORT sph_index sph_shim_velocity_xsph(int kernel, int dim, const sph_cloud *cloud,
                                                 const sph_fluid *fluid, sph_real epsilon,
                                                 const sph_vector_out *change);
SPH_SHIM_EXPORT sph_index sph_shim_wall_adami(int kernel, int dim, const sph_cloud *cloud,
                                              const sph_wall *wall, const sph_wall_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_wall_rows_adami(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_wall *wall, const sph_rows_out *out,
                                                   const sph_scalar_out *source);
SPH_SHIM_EXPORT sph_index sph_shim_wall_rows_eliminate(int dim, const sph_cloud *cloud, const sph_wall *wall,
                                                       const sph_rows_out *rows,
                                                       const sph_scalar_out *source);
SPH_SHIM_EXPORT sph_index sph_shim_density_diffusion_molteni(int kernel, int dim, const sph_cloud *cloud,
                                                             const sph_diffusion *diffusion,
                                                             const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_density_diffusion_antuono(int kernel, int dim, const sph_cloud *cloud,
                                                             const sph_diffusion *diffusion,
                                                             const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_density_diffusion_fourtakas(int kernel, int dim, const sph_cloud *cloud,
                                                               const sph_diffusion *diffusion,
                                                               const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_density_diffusion_rows_molteni(int kernel, int dim, const sph_cloud *cloud,
                                                                  const sph_diffusion *diffusion,
                                                                  const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_free_surface(int kernel, int dim, const sph_cloud *cloud,
                                                const sph_surface_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_free_surface_cone(int dim, const sph_cloud *cloud,
                                                     const sph_scalars *eigenvalue, const sph_vectors *normal,
                                                     unsigned char *flag);
SPH_SHIM_EXPORT sph_index sph_shim_shift_displacement(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_shift *shift, const sph_vector_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_shift_rates(int kernel, int dim, const sph_cloud *cloud,
                                               const sph_fluid *fluid, const sph_vectors *shift,
                                               const sph_fluid_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_transport_adami(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_fluid *fluid, const sph_vectors *transport,
                                                   sph_real background, const sph_transport_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_pressure_factor_dfsph(int kernel, int dim, const sph_cloud *cloud,
                                                         const sph_fluid *fluid, const sph_scalars *moves,
                                                         const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_fluid_rates_riemann(int kernel, int dim, const sph_cloud *cloud,
                                                       const sph_fluid *fluid,
                                                       const sph_riemann_options *options,
                                                       const sph_fluid_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_tension_css(int kernel, int dim, const sph_cloud *cloud,
                                               const sph_tension *tension,
                                               const sph_vector_out *acceleration);
SPH_SHIM_EXPORT sph_index sph_shim_tension_csf(int kernel, int dim, const sph_cloud *cloud,
                                               const sph_tension *tension, const sph_tension_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_wall_gamma(int kernel, int dim, const sph_cloud *cloud,
                                              const sph_wall_elements *elements,
                                              const sph_wall_gamma_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_wall_gradient(int kernel, int dim, const sph_cloud *cloud,
                                                 const sph_wall_terms *wall, const sph_scalars *f,
                                                 const sph_vector_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_wall_gradient_rows(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_wall_terms *wall,
                                                      const sph_gradient_rows_out *out,
                                                      const sph_vector_out *source);
SPH_SHIM_EXPORT sph_index sph_shim_wall_laplacian(int kernel, int dim, const sph_cloud *cloud,
                                                  const sph_wall_terms *wall, const sph_scalars *f,
                                                  const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_wall_laplacian_rows(int kernel, int dim, const sph_cloud *cloud,
                                                       const sph_wall_terms *wall, const sph_rows_out *out,
                                                       const sph_scalar_out *source);
SPH_SHIM_EXPORT sph_index sph_shim_collision_sequential(int dim, const sph_cloud *cloud,
                                                        const sph_collision *collision,
                                                        const sph_vector_out *velocity,
                                                        sph_collision_report *out);
SPH_SHIM_EXPORT sph_index sph_shim_collision_count(int dim, const sph_cloud *cloud,
                                                   const sph_collision *collision, const sph_vectors *v,
                                                   sph_index *count);
SPH_SHIM_EXPORT sph_index sph_shim_collision_change_weighted(int dim, const sph_cloud *cloud,
                                                             const sph_collision *collision,
                                                             const sph_vectors *v, const sph_index *count,
                                                             const sph_vector_out *change);
SPH_SHIM_EXPORT sph_index sph_shim_gas_rates(int kernel, int dim, const sph_cloud *cloud,
                                             const sph_gas *state, const sph_gas_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_velocity_gradient_difference(int kernel, int dim, const sph_cloud *cloud,
                                                                const sph_medium *medium,
                                                                const sph_vectors *v,
                                                                const sph_velocity_gradient_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_velocity_gradient_cspm(int kernel, int dim, const sph_cloud *cloud,
                                                          const sph_vectors *v,
                                                          const sph_velocity_gradient_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_shock_indicator(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_gas *state, const sph_scalars *div_v,
                                                   const sph_shock_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_divergence_difference(int kernel, int dim, const sph_cloud *cloud,
                                                         const sph_medium *medium, const sph_vectors *field,
                                                         const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_divergence_symmetric(int kernel, int dim, const sph_cloud *cloud,
                                                        const sph_medium *medium, const sph_vectors *field,
                                                        const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_symmetric(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_medium *medium, const sph_scalars *f,
                                                      const sph_vector_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_curl_difference(int kernel, int dim, const sph_cloud *cloud,
                                                   const sph_medium *medium, const sph_vectors *field,
                                                   const sph_vector_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_cleaning_rates(int kernel, int dim, const sph_cloud *cloud,
                                                  const sph_cleaning *state, const sph_cleaning_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_resistivity_ohmic(int kernel, int dim, const sph_cloud *cloud,
                                                     const sph_ohmic *state, const sph_ohmic_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_mhd_rates(int kernel, int dim, const sph_cloud *cloud,
                                             const sph_mhd *state, const sph_mhd_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_rk_correction(int kernel, int dim, const sph_cloud *cloud,
                                                 const sph_rk_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_interpolate_rk(int kernel, int dim, const sph_cloud *cloud,
                                                  const sph_rk *rk, const sph_scalars *f,
                                                  const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_interpolate_rows_rk(int kernel, int dim, const sph_cloud *cloud,
                                                       const sph_rk *rk, const sph_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_rk(int kernel, int dim, const sph_cloud *cloud, const sph_rk *rk,
                                               const sph_scalars *f, const sph_vector_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gradient_rows_rk(int kernel, int dim, const sph_cloud *cloud,
                                                    const sph_rk *rk, const sph_gradient_rows_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gas_rates_crk(int kernel, int dim, const sph_cloud *cloud,
                                                 const sph_fluid *fluid, const sph_rk *rk,
                                                 const sph_corrected_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gas_rates_iad(int kernel, int dim, const sph_cloud *cloud,
                                                 const sph_fluid *fluid, const sph_matrices *inverse,
                                                 const sph_corrected_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gravity_direct(int kernel, const sph_cloud *cloud, const sph_scalars *m,
                                                  sph_real newton, const sph_vector_out *acceleration,
                                                  const sph_scalar_out *potential);
SPH_SHIM_EXPORT sph_index sph_shim_gravity_zeta(int kernel, const sph_cloud *cloud, const sph_scalars *m,
                                                const sph_scalars *rho, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_gravity_correction(int kernel, const sph_cloud *cloud,
                                                      const sph_medium *medium, const sph_scalars *zeta,
                                                      sph_real newton, const sph_vector_out *acceleration);
SPH_SHIM_EXPORT sph_index sph_shim_deformation_gradient(int kernel, int dim, const sph_cloud *cloud,
                                                        const sph_points *x, const sph_matrices *inverse,
                                                        const sph_matrix_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_solid_acceleration(int kernel, int dim, const sph_cloud *cloud,
                                                      const sph_solid *solid,
                                                      const sph_vector_out *acceleration);
SPH_SHIM_EXPORT sph_index sph_shim_nearest_distance(int dim, const sph_cloud *targets_of,
                                                    const sph_points *sources, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_hexatic_order(const sph_cloud *cloud, const sph_scalar_out *out);
SPH_SHIM_EXPORT sph_index sph_shim_radial_distribution(int dim, const sph_cloud *cloud, sph_real farthest,
                                                       sph_real number_density, int bins, sph_real *g);
SPH_SHIM_EXPORT sph_index sph_shim_coincident_count(int dim, const sph_cloud *cloud, sph_real distance);
SPH_SHIM_EXPORT sph_index sph_shim_coincident_separate(int dim, const sph_cloud *cloud, sph_real within,
                                                       sph_real distance, const sph_vector_out *position);
SPH_SHIM_EXPORT sph_index sph_shim_conserved_sums(int dim, const sph_cloud *cloud, const sph_scalars *m,
                                                  const sph_vectors *v, sph_conserved *out);
SPH_SHIM_EXPORT sph_index sph_shim_cloud_examine(int kernel, int dim, const sph_cloud *cloud, int both_sides,
                                                 sph_index samples, sph_findings *out);
SPH_SHIM_EXPORT sph_index sph_shim_grid_build(int dim, const sph_points *sources, const sph_scalars *radius,
                                              void *work, size_t work_size, sph_grid *grid);
SPH_SHIM_EXPORT const sph_index *sph_shim_grid_permutation(const sph_grid *grid);
SPH_SHIM_EXPORT sph_index sph_shim_grid_permutation_own(const sph_grid *grid, sph_index n,
                                                        sph_index *permutation);
SPH_SHIM_EXPORT sph_index sph_shim_grid_renumber_own(sph_grid *grid, sph_index n);
SPH_SHIM_EXPORT sph_index sph_shim_grid_renumber(sph_grid *grid);
SPH_SHIM_EXPORT sph_index sph_shim_grid_lists(int dim, const sph_grid *grid, const sph_query *query,
                                              sph_index *start, sph_index *index, int64_t capacity,
                                              int64_t *pairs);
SPH_SHIM_EXPORT sph_index sph_shim_grid_count(int dim, const sph_grid *grid, const sph_query *query,
                                              sph_index *start, int64_t *pairs);
SPH_SHIM_EXPORT sph_index sph_shim_search(int dim, const sph_points *points, const sph_scalars *radius,
                                          int criterion, void *memory, size_t size, sph_neighbors *found);
SPH_SHIM_EXPORT sph_index sph_shim_part_of(int dim, const sph_points *points, const sph_scalars *radius,
                                           sph_part *part);
SPH_SHIM_EXPORT sph_index sph_shim_select_near(int dim, const sph_points *points, const sph_scalars *radius,
                                               int criterion, const sph_part *part, sph_index *chosen,
                                               int64_t *count);
SPH_SHIM_EXPORT sph_index sph_shim_list_prune(sph_index n, sph_index n_total, const sph_index *start,
                                              sph_index *index, sph_index *kept, int64_t *count);
SPH_SHIM_EXPORT sph_index sph_shim_list_sort(sph_index n, sph_index n_total, const sph_index *start,
                                             sph_index *index, const int64_t *key);
SPH_SHIM_EXPORT sph_index sph_shim_permute(sph_index n, const sph_index *permutation, const sph_real *in,
                                           size_t stride, sph_real *out);
SPH_SHIM_EXPORT sph_index sph_shim_permute_inverse(sph_index n, const sph_index *permutation,
                                                   sph_index *inverse);
SPH_SHIM_EXPORT int sph_shim_rebuild_due(int dim, const sph_points *now, const sph_points *then,
                                         sph_real skin);
