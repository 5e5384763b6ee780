/* SPDX-License-Identifier: MIT
 *
 * sph_ops.h - operators of smoothed particle hydrodynamics on the caller's arrays and neighbour lists.
 *
 * The middle one of three headers. It includes sph_kernels.h (kernels, conventions, options, status codes:
 * read its opening first); sph.h adds a neighbour search. The file is a book of chapters, one for each
 * subject, in the order of the index below. A chapter begins with its mathematics and sources. Then come its
 * types and its functions in two tiers:
 *   Pair functions   Every formula, once, as a function of values: what one particle adds to another, and
 *                    what the sums make. Hosts with loops of their own, and GPU kernels, call these.
 *   Sweeps           The loops over particles and neighbours, which hold no formula. Call them with a
 *                    constant kernel and dimension, so that both fold away (SPH_SWITCH_KERNEL turns a kernel
 *                    that is known at run time into constants).
 *
 * A CALL
 *     sph_cloud cloud = sph_cloud_of(points, list, h, volume);
 *     failed = sph_gradient_cspm(SPH_WENDLAND_C2, 3, cloud, sph_scalars_array(f), out);
 *   The cloud says who interacts: positions, neighbour lists, smoothing lengths, volumes. It is a small
 *   struct of pointers; make it wherever you need it. sph_cloud_range(cloud, first, last) has the targets
 *   first ... last - 1 only, so that threads of the host can share the work; results do not depend on how
 *   they do. A new program calls sph_cloud_examine once: it finds the mistakes that a sweep cannot see.
 *
 * DATA
 *   sph_points    positions, where they are: sph_points_separate (x[], y[], z[]), sph_points_interleaved
 *                 (xyzxyz...), sph_points_strided (array of structs)
 *   sph_scalars   one number a particle: sph_scalars_array(p), sph_scalars_strided(p, stride),
 *                 sph_scalars_same(&value): one value for all; sph_scalars_none(): there is nothing
 *   sph_vectors   one vector a particle: sph_vectors_separate (x[], y[], z[]), or any three sph_scalars
 *   sph_matrices  one matrix a particle: sph_matrices_packed(dim, p), or any three sph_vectors, its rows
 *   sph_list      neighbour lists in CSR form: target i has index[start[i]] ... index[start[i + 1] - 1]
 *   sph_..._out   where results go: pointers with a stride, so that members of structs are written in
 *                 place; a stride of 0 counts as 1. A null pointer is not wanted, where that makes sense.
 *                 `status` holds an sph_status of each target, and is contiguous.
 *   sph_..._options   what an operator may be told: all zeros are the defaults.
 *   All strides count sph_real.
 *
 *   Sources are the particles 0 ... n - 1, targets some of them. Ghost, boundary and halo particles are
 *   sources that are not targets. Probes (points where a field is wanted) are targets with the volume 0.
 *   What a comment calls that of the targets is neither read nor checked behind the last target, and need
 *   not exist there. Positions, h and volume are those of all.
 *   Nothing is a valid number: without targets every sweep answers 0 and looks at no array.
 *
 *   Lists must hold every source with r < support (more do no harm), and not the particle itself. h is that
 *   of the target, h_i, unless the operator says otherwise. volume is m / rho (an area in 2D, a length in
 *   1D). Outputs must not overlap inputs.
 *
 *   sph_points_periodic(points, lx, ly, lz) makes points periodic: every pair vector is then the one to the
 *   nearest image; positions need not be wrapped.
 *
 *   Far from the origin positions share their leading digits, and pair vectors lose them: errors grow from
 *   eps to eps |x| / spacing (float at 1000 spacings: 6e-5). Only differences of positions are ever used, so
 *   a host in float passes them relative to a point near by: the corner of a patch, the middle of a box.
 *
 *   Nothing here allocates memory, and nothing is remembered between calls.
 *
 * EXACTNESS AND ORDER, as examples/atlas measures them (it fails where a comment claims something else)
 *   Atlas: gradient exact for linear fields; order 2 inside lattices, 1 in disorder, 1 at boundaries.
 *   Exact means at every particle that has an answer, in disorder and at boundaries, too. The order is that
 *   of the root mean square of the error in dx, where h / dx stays as it is: 0 does not fall with more
 *   particles, -1 grows.
 *   Atlas: keeps momentum and angular momentum; energy never grows.
 *   This is what operators that are not linear keep to round-off, for any state. Energy is the kinetic and
 *   the elastic one of a fluid, the kinetic one of collisions, and all of gravity.
 *
 * SYMBOLS that recur, in calls and in comments
 *   k, dim               kernel and dimension (1, 2 or 3)
 *   i, j                 a target and its neighbour, or the two sides of a pair; m_i belongs to i, v_j to j
 *   x_ij, r              x_i - x_j and its length; e is x_j - x_i, where it is a vector
 *   h, q, support        smoothing length, r / h, and the radius where the kernel ends
 *   w_ij, f_ij           W and F of a pair
 *   m, rho, p, c, v, mu  mass, density, pressure, sound speed, velocity, dynamic viscosity; in the chapter of
 *                        the elliptic operator m is the mobility
 *   vx, div_v, div_B     v_ij . x_ij, and the divergences of velocity and magnetic field
 *   viscosity            of a pair: its Pi_ij
 *   f, u, field          what an operator is applied to: one number, or one vector, for each source
 *   volume, n            volumes m / rho; number of particles
 *   out, options         where results go, and what else an operator is told
 *   criterion, gradient, status, finding
 *                        a constant of the enum whose name ends so: sph_criterion, sph_elliptic_gradient, ...
 *
 * ANSWERS of sweeps: how many targets are not ok (0: all well), or a negative sph_error, and then nothing was
 *   written. `status` says more about each target. Outputs of a target that is SPH_TOO_FEW, SPH_SINGULAR,
 *   SPH_NOT_AVAILABLE or SPH_NOT_FINITE are 0, never a NaN (of several outputs, those that are not finite; h
 *   of sph_density_adaptive, which is input and output, stays positive). SPH_REFUSED tells which argument was
 *   at fault. With SPH_CHECK = 1 a sweep first scans all that it reads: positions, h, lists, values.
 *   sph_cloud_checked does that once for a cloud.
 *
 * INDEX   (k: kernel, dim: dimension; a name alone: a pair function, or a sibling of the one above)
 *   vectors        sph_dot  sph_scale  sph_subtract  sph_length
 *                  sph_mat_times  sph_mat_transposed  sph_mat_of_sym
 *   views          sph_points_strided  sph_points_separate  sph_points_interleaved  sph_points_periodic
 *                  sph_scalars_strided  sph_scalars_array  sph_scalars_same  sph_scalars_none
 *                  sph_vectors_separate
 *                  sph_vector_out_strided  sph_vector_out_separate
 *                  sph_scalar_out_strided  sph_scalar_out_array
 *                  sph_matrices_packed  sph_matrix_out_packed
 *   clouds         sph_cloud_of(points, list, h, volume)
 *                  sph_cloud_range(cloud, first, last)
 *                  sph_cloud_checked(dim, cloud)                     scanned once, and marked
 *   interpolation  sph_shepard_sum(k, dim, cloud, out)               gamma_i = sum_j V_j W_ij, with itself
 *                  sph_interpolate_shepard(k, dim, cloud, f, out)    sum_j V_j f_j W_ij / gamma_i
 *   density        sph_density_pair  sph_density_value  sph_density_omega  sph_density_mismatch
 *                  sph_density_summation(k, dim, cloud, m, out)      sum_j m_j W_ij, with itself
 *                  sph_density_adaptive(k, dim, cloud, m, options, out)
 *                      with the h that belongs to it, and Omega
 *   gradients      sph_gradient_pair_difference  sph_moment_weight_gradient  sph_moment_weight_iad
 *                  sph_solve_gradient
 *                  sph_gradient_difference(k, dim, cloud, f, out)    sum_j V_j (f_j - f_i) grad_i W_ij
 *                  sph_gradient_cspm(k, dim, cloud, f, out)          corrected: exact for linear fields
 *                  sph_gradient_rows_cspm(k, dim, cloud, out)        the same as rows
 *                  sph_gradient_iad(k, dim, cloud, f, out)           likewise, without derivatives of W
 *                  sph_gradient_rows_iad
 *                  sph_gradient_correction_cspm(k, dim, cloud, out)  the matrices that correct
 *                  sph_gradient_correction_iad
 *   Laplacians     sph_laplacian_weight_brookshaw
 *                  sph_laplacian_brookshaw(k, dim, cloud, f, out)    sum_j 2 V_j (f_i - f_j) F_ij
 *                  sph_laplacian_rows_brookshaw(k, dim, cloud, out)
 *   second         sph_test_weights_cspm  sph_test_weights_fatehi_manzari  sph_test_weights_wls
 *   derivatives    sph_moments_zero  sph_moments_add  sph_moments_add_value  sph_jet_laplacian
 *                  sph_solve_cspm  sph_solve_block
 *                  sph_coefficients_weight  sph_coefficients_cspm  sph_coefficients_block
 *                  sph_derivatives_cspm(k, dim, cloud, f, options, out)   gradient, Hessian, Laplacian
 *                  sph_derivatives_icspm(k, dim, cloud, f, options, out)  exact for quadratics
 *                  sph_derivatives_fatehi_manzari(k, dim, cloud, f, options, out)  likewise; keeps signs
 *                  sph_derivatives_wls(k, dim, cloud, f, options, out)    likewise, by least squares: robust
 *                  sph_derivatives_rows_cspm(k, dim, cloud, d, out)  rows of a combination d of derivatives
 *                  sph_derivatives_rows_icspm(k, dim, cloud, d, out) with the factor kappa
 *                  sph_derivatives_rows_fatehi_manzari  sph_derivatives_rows_wls
 *                  sph_boundary_weight_bim
 *                  sph_second_derivative_bim(k, cloud, f, left, right, out)   1D, with boundary integrals
 *                  sph_second_derivative_rows_bim(k, cloud, left, right, out)
 *   linear fits    (values and gradients at probes, mirror points, particles of another code)
 *                  sph_test_weights_liu  sph_fit_zero  sph_fit_add  sph_fit_add_value  sph_solve_fit
 *                  sph_fit_shepard  sph_fit_weight  sph_fit_value  sph_fit_extend
 *                  sph_interpolate_mls(k, dim, targets_of, sources, f, options, out)
 *                      moving least squares: exact for linear fields
 *                  sph_interpolate_liu(k, dim, targets_of, sources, f, options, out)    of mDBC walls
 *                  sph_interpolate_rows_mls(k, dim, targets_of, sources, options, out)  the same as rows
 *                  sph_interpolate_rows_liu
 *   elliptic       (div(m grad u), m a number of each particle)
 *   operator       sph_elliptic_gradient_pair  sph_elliptic_gradient_pair_basic_degiuli_ban
 *                  sph_elliptic_gradient_vector  sph_elliptic_projection  sph_mobility_pair
 *                  sph_elliptic_weight  sph_elliptic_moments_radial
 *                  sph_elliptic_invert  sph_sym_eigenvalues
 *                  sph_elliptic_brookshaw(k, dim, cloud, m, options, u, out)
 *                      sum_j V_j (m_i + m_j) (u_i - u_j) F_ij
 *                  sph_elliptic_brookshaw_corrected(k, dim, cloud, m, options, u, out)   times tr C / dim
 *                  sph_elliptic_schwaiger(k, dim, cloud, m, options, u, out)
 *                      exact for linear u and constant m
 *                  sph_elliptic_msph(k, dim, cloud, m, options, u, out)
 *                      the same numbers for radial gradients
 *                  sph_elliptic_basic_degiuli_ban(k, dim, cloud, m, options, u, out)
 *                      without derivatives of the kernel; exact for |x|^2
 *                  sph_elliptic_rows_brookshaw(k, dim, cloud, m, options, out)
 *                      rows (meshless transmissibilities)
 *                  sph_elliptic_rows_brookshaw_corrected  sph_elliptic_rows_schwaiger  sph_elliptic_rows_msph
 *                  sph_elliptic_rows_basic_degiuli_ban
 *                  sph_elliptic_diagnose(k, dim, cloud, options, out)
 *                      signs, moments, free-surface indicator
 *                  sph_elliptic_rows_anisotropic(k, dim, cloud, mobility, out)  div(M grad u), M diagonal
 *                  sph_elliptic_tensor(k, dim, cloud, mobility, u, out)
 *                      div(M grad u) for any symmetric M
 *                  sph_elliptic_rows_tensor(k, dim, cloud, mobility, out)
 *                  sph_elliptic_rows_boundary(k, dim, cloud, m, options, boundary, out)
 *                      Dirichlet, Neumann, Robin
 *   rows           sph_rows_apply(cloud, row, diagonal, u, out)      sum_p row[p] (u_j - u_i)
 *                  sph_rows_monotone(cloud, row, diagonal, monotone) how many rows are not of an M-matrix
 *                  sph_rows_time_step(cloud, row, dt)                longest stable explicit step
 *                  sph_rows_growth(dim, cloud, row, tau, wave, re, im)   von Neumann's growth factor
 *                  sph_csr_size(cloud)                               entries of the matrix, at most
 *                  sph_csr_assemble(cloud, row, diagonal, drop_zeros, out, entries)
 *   fluid          sph_pressure_pair_monaghan  sph_pressure_pair_colagrossi  sph_pressure_pair_hu_adams
 *                  sph_viscosity_pair_monaghan  sph_viscosity_pair_linear  sph_signal_speed
 *                  sph_viscosity_signal  sph_viscosity_pair_signal  sph_viscosity_mu_pair_morris
 *                  sph_viscosity_mu_pair_monaghan_cleary  sph_viscosity_mu_pair_espanol_revenga
 *                  sph_kernel_f_apart  sph_density_rate_pair_mass  sph_density_rate_pair_volume
 *                  sph_fluid_pair_monaghan  sph_fluid_pair_colagrossi  sph_fluid_pair_hu_adams
 *                  sph_velocity_pair_xsph  sph_wall_pair_adami  sph_wall_pressure  sph_wall_fluid_velocity
 *                  sph_wall_row_weight  sph_wall_mirror  sph_wall_velocity_no_slip
 *                  sph_wall_velocity_free_slip
 *                  sph_pressure_tait  sph_density_tait  sph_sound_speed_tait
 *                  sph_time_step_sound  sph_time_step_force  sph_time_step_viscous_nu
 *                  sph_density_number(k, dim, cloud, m, out)         m_i sum_j W_ij
 *                  sph_fluid_rates_monaghan(k, dim, cloud, fluid, out)    acceleration, density, heating
 *                  sph_fluid_rates_colagrossi, sph_fluid_rates_hu_adams   where the density jumps
 *                  sph_viscosity_mu_morris(k, dim, cloud, fluid, mu, acceleration)   physical viscosity
 *                  sph_viscosity_mu_monaghan_cleary(k, dim, cloud, fluid, mu, acceleration)
 *                  sph_viscosity_mu_espanol_revenga(k, dim, cloud, fluid, mu, acceleration)
 *                      with shear and bulk viscosity
 *                  sph_velocity_xsph(k, dim, cloud, fluid, epsilon, change)
 *                  sph_wall_adami(k, dim, cloud, wall, out)          pressure and velocity of wall particles
 *                  sph_wall_rows_adami(k, dim, cloud, wall, out, source)
 *                      the same pressure as rows of a matrix
 *                  sph_wall_rows_eliminate(dim, cloud, wall, rows, source)
 *                      rows of the fluid without unknowns of the wall
 *   liquids        sph_density_difference_molteni  sph_density_difference_antuono
 *                  sph_density_difference_fourtakas  sph_density_slope  sph_density_diffusion_weight
 *                  sph_time_step_density_diffusion
 *                  sph_density_diffusion_molteni(k, dim, cloud, diffusion, out)
 *                      density rate with density diffusion
 *                  sph_density_diffusion_antuono(k, dim, cloud, diffusion, out)   delta-SPH
 *                  sph_density_diffusion_fourtakas(k, dim, cloud, diffusion, out)
 *                  sph_density_diffusion_rows_molteni(k, dim, cloud, diffusion, out)
 *                  sph_sym_least_eigenvalue  sph_surface_of  sph_surface_normal  sph_surface_covers
 *                  sph_free_surface(k, dim, cloud, out)              div r, lambda, normal
 *                  sph_free_surface_cone(dim, cloud, eigenvalue, normal, flag)
 *                      which particles are the surface
 *                  sph_shift_pair  sph_shift_strength_skillen  sph_shift_strength_sun
 *                  sph_shift_at_surface  sph_shift_limited  sph_shift_rate_pair  sph_transport_pair_adami
 *                  sph_shift_displacement(k, dim, cloud, shift, out) keeps particles even
 *                  sph_shift_rates(k, dim, cloud, fluid, shift, out) what particles that are shifted carry
 *                  sph_transport_adami(k, dim, cloud, fluid, transport, background, out)
 *                  sph_pressure_factor_pair_dfsph  sph_pressure_factor_value_dfsph
 *                  sph_pressure_factor_dfsph(k, dim, cloud, fluid, moves, out)      alpha of DFSPH
 *   Riemann        sph_riemann_side_of  sph_riemann_beta  sph_riemann_rest  sph_riemann_acoustic
 *   solver         sph_fluid_pair_riemann
 *                  sph_fluid_rates_riemann(k, dim, cloud, fluid, options, out)
 *                      fluid rates with the dissipation of a Riemann solver
 *   surface        sph_unit_normal_of  sph_curvature_pair  sph_curvature_value  sph_tension_csf_value
 *   tension        sph_tension_stress_times  sph_tension_pair_css  sph_tension_pair_akinci
 *                  sph_tension_css(k, dim, cloud, tension, acceleration)   by the stress: keeps momentum
 *                  sph_tension_csf(k, dim, cloud, tension, out)      by the curvature, and the curvature
 *   walls by       sph_wall_kernel_of  sph_wall_point  sph_wall_segment  sph_wall_triangle
 *   boundary       sph_wall_gradient_value  sph_wall_laplacian_value
 *   integrals      sph_wall_gamma(k, dim, cloud, elements, out)      gamma and grad gamma, exact
 *                  sph_wall_gradient(k, dim, cloud, wall, f, out)    in sum form
 *                  sph_wall_gradient_rows(k, dim, cloud, wall, out, source)         the same as rows
 *                  sph_wall_laplacian(k, dim, cloud, wall, f, out)   BIM in more than one dimension
 *                  sph_wall_laplacian_rows(k, dim, cloud, wall, out, source)
 *   collisions     sph_collision_pair
 *                  sph_collision_sequential(dim, cloud, collision, velocity, out)
 *                  sph_collision_count(dim, cloud, collision, v, count)
 *                  sph_collision_change_weighted(dim, cloud, collision, v, count, change)
 *   gas            sph_medium_weight  sph_pair_weights_of  sph_medium_difference  sph_conductivity_speed
 *                  sph_gas_pair  sph_gas_work  sph_gas_value  sph_flow_of  sph_velocity_gradient_pair
 *                  sph_viscosity_factor_balsara  sph_viscosity_switch_rate  sph_shock_pair  sph_shock_value
 *                  sph_shock_factor_cullen_dehnen  sph_shock_factor_phantom
 *                  sph_viscosity_target_cullen_dehnen  sph_viscosity_target_phantom
 *                  sph_viscosity_switch_after
 *                  sph_gas_rates(k, dim, cloud, state, out)          momentum, energy, div v, v_sig
 *                  sph_velocity_gradient_difference(k, dim, cloud, medium, v, out)
 *                      div v, |curl v|, shear
 *                  sph_velocity_gradient_cspm(k, dim, cloud, v, out) the same, exact for linear v
 *                  sph_shock_indicator(k, dim, cloud, state, div_v, out)   for switches of viscosity
 *   magneto-       sph_mhd_traction  sph_mhd_fast_speed
 *   hydrodynamics  sph_cleaning_rate  sph_cleaning_rate_scaled  sph_cleaning_sigma
 *   and            sph_cleaning_rate_velocity  sph_euler_potentials  sph_resistivity_switch
 *   divergence     sph_divergence_pair_difference  sph_curl_pair_difference
 *   cleaning       sph_divergence_pair_symmetric  sph_gradient_pair_symmetric
 *                  sph_induction_pair  sph_resistivity_pair  sph_resistivity_pair_ohmic
 *                  sph_resistivity_heat  sph_time_step_resistivity  sph_mhd_pair  sph_mhd_value
 *                  sph_divergence_difference(k, dim, cloud, medium, field, out)
 *                  sph_divergence_symmetric(k, dim, cloud, medium, field, out)
 *                  sph_gradient_symmetric(k, dim, cloud, medium, f, out)
 *                  sph_curl_difference(k, dim, cloud, medium, field, out)
 *                  sph_cleaning_rates(k, dim, cloud, state, out)     conservative cleaning of B alone
 *                  sph_resistivity_ohmic(k, dim, cloud, state, out)  physical resistivity, with its heat
 *                  sph_mhd_rates(k, dim, cloud, state, out)
 *                      momentum, induction, energy, psi, div B, v_sig
 *   reproducing    sph_rk_moments_pair  sph_rk_solve  sph_rk_pair  sph_rk_pair_difference
 *   kernels        sph_gradient_pair_iad  sph_gas_pair_crk  sph_gas_pair_iad
 *                  sph_rk_correction(k, dim, cloud, out)             makes kernels exact
 *                  sph_interpolate_rk(k, dim, cloud, rk, f, out)     for linear fields, everywhere
 *                  sph_interpolate_rows_rk(k, dim, cloud, rk, out)
 *                  sph_gradient_rk(k, dim, cloud, rk, f, out)        likewise
 *                  sph_gradient_rows_rk(k, dim, cloud, rk, out)
 *                  sph_gas_rates_crk(k, dim, cloud, fluid, rk, out)  forces that conserve (CRKSPH)
 *                  sph_gas_rates_iad(k, dim, cloud, fluid, inverse, out)  by the integral approach
 *   gravity        sph_gravity_pair  sph_gravity_correction_pair  sph_gravity_zeta_value
 *                  sph_gravity_direct(k, cloud, m, newton, acceleration, potential)   all pairs
 *                  sph_gravity_zeta(k, cloud, m, rho, out)
 *                  sph_gravity_correction(k, cloud, medium, zeta, newton, acceleration)
 *                      where h follows the density
 *   solids         sph_elastic_of  sph_sound_speed_elastic
 *                  sph_stress_saint_venant_kirchhoff  sph_stress_neo_hookean
 *                  sph_deformation_pair  sph_deformation_value  sph_stress_pair  sph_hourglass_pair
 *                  sph_deformation_gradient(k, dim, cloud, x, inverse, out)   exact for affine maps
 *                  sph_solid_acceleration(k, dim, cloud, solid, acceleration)
 *                      by stress and hourglass control: keeps both momenta
 *   measures       sph_nearest_distance(dim, cloud, sources, out)
 *                  sph_hexatic_order(cloud, out)
 *                  sph_radial_distribution(dim, cloud, farthest, number_density, bins, g)
 *                  sph_coincident_count(dim, cloud, distance)
 *                  sph_coincident_separate(dim, cloud, within, distance, position)
 *                  sph_conserved_sums(dim, cloud, m, v, out)
 *                      mass, momentum, angular momentum, kinetic energy
 *   mistakes       sph_cloud_examine(k, dim, cloud, both_sides, samples, found)
 *                      call it once on a new cloud
 *                  sph_finding_text(finding)
 */
#include "sph_kernels.h" /* each time, because it looks at the options each time */

#ifndef SPH_OPS_H
#define SPH_OPS_H

#if SPH_VERSION != 200
#error "sph_ops.h and sph_kernels.h are of different releases"
#endif

/* clang-format off */
#if SPH_SINGLE && !SPH_OPENCL
#  define SPHI_COPYSIGN(x, y) copysignf(x, y)
#  define SPHI_LOG(x) logf(x)
#  define SPHI_POW(x, y) powf(x, y)
#  define SPHI_SIN(x) sinf(x)
#  define SPHI_COS(x) cosf(x)
#  define SPHI_ACOS(x) acosf(x)
#  define SPHI_ATAN2(y, x) atan2f(y, x)
#else
#  define SPHI_COPYSIGN(x, y) copysign(x, y)
#  define SPHI_LOG(x) log(x)
#  define SPHI_POW(x, y) pow(x, y)
#  define SPHI_SIN(x) sin(x)
#  define SPHI_COS(x) cos(x)
#  define SPHI_ACOS(x) acos(x)
#  define SPHI_ATAN2(y, x) atan2(y, x)
#endif
SPHI_BEGIN
/* clang-format on */

/* ================================================================ vectors
 *
 * Vectors and symmetric tensors are passed by value. The functions use their first dim components.
 */

typedef struct sph_vec {
    sph_real x, y, z; /* components beyond dim are 0 */
    SPHI_TCC_PAD
} sph_vec;

/* A symmetric tensor. Components beyond dim are not read. */
typedef struct sph_sym {
    sph_real xx, xy, yy, xz, yz, zz;
} sph_sym;

/* a . b, the sum over dim components. */
SPH_FN sph_real sph_dot(int dim, sph_vec a, sph_vec b)
{
    sph_real s = a.x * b.x;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    if (dim > 1) s += a.y * b.y;
    if (dim > 2) s += a.z * b.z;
    return s;
}
/* a v, all three components. */
SPH_FN sph_vec sph_scale(sph_real a, sph_vec v)
{
    v.x *= a;
    v.y *= a;
    v.z *= a;
    return v;
}
/* a - b. Components beyond dim are those of a. */
SPH_FN sph_vec sph_subtract(int dim, sph_vec a, sph_vec b)
{
    SPH_ASSERT(SPHI_IS_DIM(dim));
    a.x -= b.x;
    if (dim > 1) a.y -= b.y;
    if (dim > 2) a.z -= b.z;
    return a;
}
/* a + b, likewise. */
SPH_FN sph_vec sphi_plus(int dim, sph_vec a, sph_vec b)
{
    a.x += b.x;
    if (dim > 1) a.y += b.y;
    if (dim > 2) a.z += b.z;
    return a;
}
/* a x b, of three components each. */
SPH_FN sph_vec sphi_cross(sph_vec a, sph_vec b)
{
    sph_vec c;
    c.x = a.y * b.z - a.z * b.y;
    c.y = a.z * b.x - a.x * b.z;
    c.z = a.x * b.y - a.y * b.x;
    return c;
}
/* |v| = sqrt(v . v), over dim components. */
SPH_FN sph_real sph_length(int dim, sph_vec v) { return SPHI_SQRT(sph_dot(dim, v, v)); }

/* The product s v of a tensor and a vector. Components beyond dim are 0. */
SPH_FN sph_vec sphi_sym_times(int dim, sph_sym s, sph_vec v)
{
    sph_vec u;
    u.x = s.xx * v.x;
    u.y = u.z = SPH_R(0);
    if (dim > 1) {
        u.x += s.xy * v.y;
        u.y = s.xy * v.x + s.yy * v.y;
    }
    if (dim > 2) {
        u.x += s.xz * v.z;
        u.y += s.yz * v.z;
        u.z = s.xz * v.x + s.yz * v.y + s.zz * v.z;
    }
    return u;
}

/* A matrix by its rows: component y of the row x is the entry in the first row and the second column. Rows
   and components beyond dim are not read. */
typedef struct sph_mat {
    sph_vec x, y, z;
} sph_mat;

/* The product a v. Components beyond dim are 0. */
SPH_FN sph_vec sph_mat_times(int dim, sph_mat a, sph_vec v)
{
    sph_vec u;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    u.x = sph_dot(dim, a.x, v);
    u.y = dim > 1 ? sph_dot(dim, a.y, v) : SPH_R(0);
    u.z = dim > 2 ? sph_dot(dim, a.z, v) : SPH_R(0);
    return u;
}
/* The transpose of a. Entries beyond dim are 0. */
SPH_FN sph_mat sph_mat_transposed(int dim, sph_mat a)
{
    sph_mat t;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    t.x.x = a.x.x;
    t.x.y = t.x.z = t.y.x = t.y.y = t.y.z = t.z.x = t.z.y = t.z.z = SPH_R(0);
    if (dim > 1) t.x.y = a.y.x, t.y.x = a.x.y, t.y.y = a.y.y;
    if (dim > 2) t.x.z = a.z.x, t.y.z = a.z.y, t.z.x = a.x.z, t.z.y = a.y.z, t.z.z = a.z.z;
    return t;
}
/* The symmetric tensor s as a matrix. Entries beyond dim are 0. */
SPH_FN sph_mat sph_mat_of_sym(int dim, sph_sym s)
{
    sph_mat a;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    a.x.x = s.xx;
    a.x.y = a.x.z = a.y.x = a.y.y = a.y.z = a.z.x = a.z.y = a.z.z = SPH_R(0);
    if (dim > 1) a.x.y = a.y.x = s.xy, a.y.y = s.yy;
    if (dim > 2) a.x.z = a.z.x = s.xz, a.y.z = a.z.y = s.yz, a.z.z = s.zz;
    return a;
}

/* ================================================================ views and clouds
 *
 * A view says where numbers of the caller are: pointers and a stride, which counts sph_real. It copies
 * nothing and owns nothing. A cloud combines the views that say who interacts: positions, neighbour lists,
 * smoothing lengths and volumes.
 */

/* Positions: the coordinates of particle i are x[i * stride], y[i * stride] and z[i * stride]. */
typedef struct sph_points {
    const SPH_GLOBAL sph_real *x, *y, *z; /* y is read in 2D and 3D only, z in 3D only */
    size_t stride;                        /* from one particle to the next, in sph_real; at least 1 */
    sph_index n;                          /* number of particles; all of them are sources */
    sph_vec box;                          /* periodic lengths of the first dim axes; 0: the axis is open */
} sph_points;

/* One number for each particle: that of particle i is p[i * stride]. */
typedef struct sph_scalars {
    const SPH_GLOBAL sph_real *p;
    size_t stride; /* 0: one value for all */
} sph_scalars;

/* Neighbour lists in CSR form: the neighbours of target i are index[start[i]] ... index[start[i + 1] - 1]. */
typedef struct sph_list {
    const SPH_GLOBAL sph_index *start, *index;
} sph_list;

/* Points whose coordinates x, y, z are `stride` numbers apart, as in an array of structs. Every axis is open.
   y and z may be null where the dimension does not need them. */
SPH_FN sph_points sph_points_strided(sph_index n, const SPH_GLOBAL sph_real *x, const SPH_GLOBAL sph_real *y,
                                     const SPH_GLOBAL sph_real *z, size_t stride)
{
    sph_points p;
    p.x = x;
    p.y = y;
    p.z = z;
    p.stride = stride;
    p.n = n;
    p.box.x = p.box.y = p.box.z = SPH_R(0);
    return p;
}
/* Points in separate arrays x[], y[], z[]. */
SPH_FN sph_points sph_points_separate(sph_index n, const SPH_GLOBAL sph_real *x, const SPH_GLOBAL sph_real *y,
                                      const SPH_GLOBAL sph_real *z)
{
    return sph_points_strided(n, x, y, z, 1);
}
/* Points in one array xyz of the order xyzxyz..., which has dim numbers for each particle. */
SPH_FN sph_points sph_points_interleaved(sph_index n, int dim, const SPH_GLOBAL sph_real *xyz)
{
    return sph_points_strided(n, xyz, dim > 1 && xyz ? xyz + 1 : xyz, dim > 2 && xyz ? xyz + 2 : xyz,
                              (size_t)(dim > 0 ? dim : 0));
}
/* The same points in a box that repeats with the lengths lx, ly, lz; a length of 0 leaves its axis open.
   Every operator then uses the nearest image of each neighbour. There are two exceptions: BIM needs ends and
   refuses a periodic axis, and sph_gravity_direct does not use the box. Positions need not be wrapped. They
   may lie up to a million (2^20) lengths from the origin, but they lose as many digits there: 20 bits, or six
   decimal digits. Supports must not reach beyond half a length. */
SPH_FN sph_points sph_points_periodic(sph_points p, sph_real lx, sph_real ly, sph_real lz)
{
    p.box.x = lx;
    p.box.y = ly;
    p.box.z = lz;
    return p;
}
/* Numbers that are `stride` numbers apart: p[0], p[stride], p[2 * stride], ... */
SPH_FN sph_scalars sph_scalars_strided(const SPH_GLOBAL sph_real *p, size_t stride)
{
    sph_scalars s;
    s.p = p;
    s.stride = stride;
    return s;
}
/* A contiguous array. */
SPH_FN sph_scalars sph_scalars_array(const SPH_GLOBAL sph_real *p) { return sph_scalars_strided(p, 1); }
/* The number *value for all particles. */
SPH_FN sph_scalars sph_scalars_same(const SPH_GLOBAL sph_real *value)
{
    return sph_scalars_strided(value, 0);
}
/* Nothing: for values that the caller does not have, or that a sweep does not need. */
SPH_FN sph_scalars sph_scalars_none(void) { return sph_scalars_strided(0, 0); }

/* One vector for each particle. Only the first dim components are read. */
typedef struct sph_vectors {
    sph_scalars x, y, z;
} sph_vectors;
/* Where results go: separate arrays, or members of structs that are `stride` numbers apart. A stride of 0
   counts as 1. Where that makes sense, a null pointer says that a result is not wanted. status holds an
   sph_status for each target, and is contiguous. */
typedef struct sph_vector_out {
    SPH_GLOBAL sph_real *x, *y, *z;
    size_t stride;
} sph_vector_out;
typedef struct sph_scalar_out {
    SPH_GLOBAL sph_real *p;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_scalar_out;
/* Vectors in separate arrays x[], y[], z[]. */
SPH_FN sph_vectors sph_vectors_separate(const SPH_GLOBAL sph_real *x, const SPH_GLOBAL sph_real *y,
                                        const SPH_GLOBAL sph_real *z)
{
    sph_vectors v;
    v.x = sph_scalars_array(x);
    v.y = sph_scalars_array(y);
    v.z = sph_scalars_array(z);
    return v;
}
/* Vectors go to x[i * stride], y[i * stride], z[i * stride]. Only the first dim components are written. */
SPH_FN sph_vector_out sph_vector_out_strided(SPH_GLOBAL sph_real *x, SPH_GLOBAL sph_real *y,
                                             SPH_GLOBAL sph_real *z, size_t stride)
{
    sph_vector_out v;
    v.x = x;
    v.y = y;
    v.z = z;
    v.stride = stride;
    return v;
}
/* Vectors go to separate arrays x[], y[], z[]. */
SPH_FN sph_vector_out sph_vector_out_separate(SPH_GLOBAL sph_real *x, SPH_GLOBAL sph_real *y,
                                              SPH_GLOBAL sph_real *z)
{
    return sph_vector_out_strided(x, y, z, 1);
}
/* One matrix for each particle, by its rows. Only the first dim rows and columns are read. */
typedef struct sph_matrices {
    sph_vectors x, y, z;
} sph_matrices;
/* Where matrices go, by their rows. Only the first dim rows and columns are written. */
typedef struct sph_matrix_out {
    sph_vector_out x, y, z;
} sph_matrix_out;
/* Matrices that lie one behind the other, dim * dim numbers each, row by row. */
SPH_FN sph_matrices sph_matrices_packed(int dim, const SPH_GLOBAL sph_real *p)
{
    const size_t each = (size_t)(dim * dim), row = (size_t)dim;
    sph_matrices m;
    m.x.x = sph_scalars_strided(p, each);
    m.x.y = m.x.z = m.y.x = m.y.y = m.y.z = m.z.x = m.z.y = m.z.z = m.x.x;
    if (p && dim > 1) m.x.y.p = p + 1, m.y.x.p = p + row, m.y.y.p = p + row + 1;
    if (p && dim > 2) m.x.z.p = p + 2, m.y.z.p = p + 5, m.z.x.p = p + 6, m.z.y.p = p + 7, m.z.z.p = p + 8;
    return m;
}
/* The same for results. */
SPH_FN sph_matrix_out sph_matrix_out_packed(int dim, SPH_GLOBAL sph_real *p)
{
    const size_t each = (size_t)(dim * dim), row = (size_t)dim;
    sph_matrix_out m;
    m.x = sph_vector_out_strided(p, p && dim > 1 ? p + 1 : p, p && dim > 2 ? p + 2 : p, each);
    m.y = m.z = m.x;
    if (p && dim > 1) m.y.x += row, m.y.y += row, m.y.z += row;
    if (p && dim > 2) m.z.x += 6, m.z.y += 6, m.z.z += 6;
    return m;
}
/* Numbers go to p[i * stride], and their status to status[i]. status may be null. */
SPH_FN sph_scalar_out sph_scalar_out_strided(SPH_GLOBAL sph_real *p, size_t stride,
                                             SPH_GLOBAL unsigned char *status)
{
    sph_scalar_out s;
    s.p = p;
    s.stride = stride;
    s.status = status;
    return s;
}
/* Numbers go to a contiguous array. status may be null. */
SPH_FN sph_scalar_out sph_scalar_out_array(SPH_GLOBAL sph_real *p, SPH_GLOBAL unsigned char *status)
{
    return sph_scalar_out_strided(p, 1, status);
}

/* Who interacts: the sources with their volumes m / rho (areas in 2D, lengths in 1D), the targets first ...
   last - 1 among them, and the smoothing length and the neighbours of each target. A cloud is passed by
   value, as one argument, and owns nothing. */
typedef struct sph_cloud {
    sph_points points;
    sph_list list;
    sph_scalars h, volume;
    sph_index first, last;
    /* 0: every sweep scans what it reads. 1: sph_cloud_checked has scanned the cloud, and set largest_h.
       Negative: sph_cloud_checked found this sph_error, and every sweep answers it. */
    int checked;
    sph_real largest_h;
} sph_cloud;
/* A cloud of points whose targets are all particles. What a sweep does not need may be left out with
   sph_scalars_none(): volumes where it takes masses, h where it has no kernel. */
SPH_FN sph_cloud sph_cloud_of(sph_points points, sph_list list, sph_scalars h, sph_scalars volume)
{
    sph_cloud c;
    c.points = points;
    c.list = list;
    c.h = h;
    c.volume = volume;
    c.first = 0;
    c.last = points.n;
    c.checked = 0;
    c.largest_h = SPH_R(0);
    return c;
}
/* The same cloud with the targets first ... last - 1 only. Threads of a host share the targets in this way,
   and ghosts are left out, which are sources but not targets. A range that has targets which were not checked
   loses the mark of sph_cloud_checked. */
SPH_FN sph_cloud sph_cloud_range(sph_cloud cloud, sph_index first, sph_index last)
{
    if (cloud.checked == 1 && (first < cloud.first || last > cloud.last)) cloud.checked = 0;
    cloud.first = first;
    cloud.last = last;
    return cloud;
}

/* Where derivatives go: the gradient (gx, gy, gz), the Hessian (hxx ... hzz), its trace (laplacian), and the
   conditioning of the system (1 good, 0 singular). What is null is not wanted; components beyond dim are not
   written. */
typedef struct sph_derivatives_out {
    SPH_GLOBAL sph_real *gx, *gy, *gz, *hxx, *hxy, *hyy, *hxz, *hyz, *hzz, *laplacian, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status; /* sph_status, contiguous */
} sph_derivatives_out;

/* Where rows go. The row of target i has one weight for each entry p = start[i] ... start[i + 1] - 1 of its
   list, so that for an operator D
       factor[i] D f_i = diagonal[i] f_i + sum_p row[p] f_index[p],   diagonal[i] = -sum_p row[p].
   All pointers but row may be null. The stride is that of diagonal, factor and conditioning, which have one
   number for each target; row is contiguous. */
typedef struct sph_rows_out {
    SPH_GLOBAL sph_real *row, *diagonal, *factor, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_rows_out;

/* Where the matrices go that correct a gradient, and the conditioning of each (1 good, 0 singular).
   conditioning and status may be null. The stride is that of conditioning. */
typedef struct sph_correction_out {
    sph_matrix_out inverse;
    SPH_GLOBAL sph_real *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_correction_out;

/* Where the rows of a gradient go: one weight for each entry of the list and each component, contiguous.
   conditioning and status may be null. The stride is that of conditioning. */
typedef struct sph_gradient_rows_out {
    SPH_GLOBAL sph_real *x, *y, *z, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_gradient_rows_out;

/* The number, and the position, of particle i. */
SPH_FN sph_real sphi_at(sph_scalars a, sph_index i) { return a.p[(size_t)i * a.stride]; }
SPH_FN sph_vec sphi_point(int dim, sph_points p, sph_index i)
{
    const size_t o = (size_t)i * p.stride;
    sph_vec v;
    v.x = p.x[o];
    v.y = dim > 1 ? p.y[o] : SPH_R(0);
    v.z = dim > 2 ? p.z[o] : SPH_R(0);
    return v;
}
/* d minus the nearest multiple of the length, which is 0 for an open axis. Loops with this function must
   vectorise with SSE2. So it rounds by a conversion to int and back: rint and floor are library calls there,
   and -ffast-math deletes the trick of adding and subtracting 2^52. It masks an open axis out, and has no
   branch. The mask also lets the compiler remove the code where the length is known to be 0: an int & 0 is 0
   by any rule, but a product of a real with 0 is not. */
SPH_FN sph_real sphi_nearest_image(sph_real d, sph_real length)
{
    const sphi_int32 periodic = length > SPH_R(0);
    const sph_real inverse = (sph_real)periodic / (length + (sph_real)!periodic), t = d * inverse;
    const sphi_int32 images = (sphi_int32)(t + SPHI_COPYSIGN(SPH_R(0.5), t)) & -periodic;
    return d - length * (sph_real)images;
}
/* a - b, the vector from b to a; on periodic axes the one between the nearest images. All operators that use
   the box form their pair vectors here. */
SPH_FN sph_vec sphi_separation(int dim, sph_points p, sph_vec a, sph_vec b)
{
    sph_vec d = sph_subtract(dim, a, b);
    d.x = sphi_nearest_image(d.x, p.box.x);
    if (dim > 1) d.y = sphi_nearest_image(d.y, p.box.y);
    if (dim > 2) d.z = sphi_nearest_image(d.z, p.box.z);
    return d;
}

/* ================================================================ checks
 *
 * A sweep checks its arguments before it writes anything. With SPH_CHECK = 1 it also scans the numbers in the
 * arrays that it reads. A check or scan returns 0 or a negative sph_error. A result that is not finite is
 * never stored: 0 is stored in its place.
 */

/* 1 if x is finite. It looks at the bits, because -ffast-math removes comparisons with NaN. */
SPH_FN int sphi_finite(sph_real x)
{
#if SPH_OPENCL
    return isfinite(x);
#elif SPH_SINGLE
    union {
        float f;
        uint32_t u;
    } v;
    v.f = x;
    return (v.u & 0x7f800000u) != 0x7f800000u;
#else
    union {
        double f;
        uint64_t u;
    } v;
    v.f = x;
    return (v.u & 0x7ff0000000000000u) != 0x7ff0000000000000u;
#endif
}
/* Stores a value, or 0 if it is not finite; it returns 1 then. With a null pointer it stores nothing, and
   returns 0. */
SPH_FN int sphi_put(SPH_GLOBAL sph_real *p, size_t stride, sph_index i, sph_real value)
{
    const int ok = sphi_finite(value);
    if (p) p[(size_t)i * stride] = ok ? value : SPH_R(0);
    return p && !ok;
}
/* A stride of 0 counts as 1. */
SPH_FN size_t sphi_stride(size_t given) { return given ? given : 1; }
/* Stores a vector, or 0 if a component overflowed; it returns 1 then. */
SPH_FN int sphi_store_vector(int dim, sph_vector_out out, sph_index i, sph_vec a)
{
    const size_t at = (size_t)i * sphi_stride(out.stride);
    const int lost = !sphi_finite(a.x) || (dim > 1 && !sphi_finite(a.y)) || (dim > 2 && !sphi_finite(a.z));
    out.x[at] = lost ? SPH_R(0) : a.x;
    if (dim > 1) out.y[at] = lost ? SPH_R(0) : a.y;
    if (dim > 2) out.z[at] = lost ? SPH_R(0) : a.z;
    return lost;
}
/* Stores a matrix, or 0 if an entry overflowed; it returns 1 then. */
SPH_FN int sphi_store_matrix(int dim, sph_matrix_out out, sph_index i, sph_mat a)
{
    int lost = sphi_store_vector(dim, out.x, i, a.x);
    if (dim > 1) lost |= sphi_store_vector(dim, out.y, i, a.y);
    if (dim > 2) lost |= sphi_store_vector(dim, out.z, i, a.z);
    if (!lost) return 0;
    a.x.x = a.x.y = a.x.z = SPH_R(0);
    sphi_store_vector(dim, out.x, i, a.x);
    if (dim > 1) sphi_store_vector(dim, out.y, i, a.x);
    if (dim > 2) sphi_store_vector(dim, out.z, i, a.x);
    return 1;
}
/* Stores the value of a target (the caller passes 0 where there is none) and its status. Returns 1 if the
   status is not SPH_OK. */
SPH_FN int sphi_answer(sph_scalar_out out, sph_index i, sph_real value, int state)
{
    out.p[(size_t)i * sphi_stride(out.stride)] = value;
    if (out.status) out.status[i] = (unsigned char)state;
    return state != SPH_OK;
}
/* Stores the status of a target: SPH_NOT_FINITE if a result was lost, else SPH_OK. */
SPH_FN void sphi_tell(SPH_GLOBAL unsigned char *status, sph_index i, int lost)
{
    if (status) status[i] = (unsigned char)(lost ? SPH_NOT_FINITE : SPH_OK);
}
/* sphi_answer for a value that always exists, but may overflow. */
SPH_FN int sphi_store(sph_scalar_out out, sph_index i, sph_real value)
{
    const int ok = sphi_finite(value);
    return sphi_answer(out, i, ok ? value : SPH_R(0), ok ? (int)SPH_OK : (int)SPH_NOT_FINITE);
}
/* Sets the entries first ... last - 1 of a row to 0 if one of them, or their sum (the diagonal), overflowed.
   It returns 1 then. */
SPH_FN int sphi_row_finite(SPH_GLOBAL sph_real *row, sph_index first, sph_index last)
{
    sph_real sum = SPH_R(0);
    sph_index p;
    int lost;
    for (p = first; p < last; p++) sum += row[p]; /* the sum is not finite if an entry is not */
    lost = !sphi_finite(sum);
    if (lost)
        for (p = first; p < last; p++) row[p] = SPH_R(0);
    return lost;
}
/* The same of the rows of a gradient: if one component overflowed, or lost is 1 already, all are 0. */
SPH_FN int sphi_gradient_row_finite(int dim, sph_gradient_rows_out out, sph_list list, sph_index i, int lost)
{
    sph_index p;
    lost |= sphi_row_finite(out.x, list.start[i], list.start[i + 1]);
    if (dim > 1) lost |= sphi_row_finite(out.y, list.start[i], list.start[i + 1]);
    if (dim > 2) lost |= sphi_row_finite(out.z, list.start[i], list.start[i + 1]);
    for (p = list.start[i]; lost && p < list.start[i + 1]; p++) {
        out.x[p] = SPH_R(0);
        if (dim > 1) out.y[p] = SPH_R(0);
        if (dim > 2) out.z[p] = SPH_R(0);
    }
    return lost;
}
/* Stores what belongs to the row of a target: the factor 1, the conditioning, the status, and the diagonal
   -sum_p row[p] if with_diagonal is 1. */
SPH_FN void sphi_row_answer(sph_rows_out out, sph_list list, sph_index i, int with_diagonal,
                            sph_real conditioning, int state)
{
    const size_t stride = sphi_stride(out.stride);
    sph_index p;
    if (out.diagonal && with_diagonal) {
        sph_real sum = SPH_R(0);
        for (p = list.start[i]; p < list.start[i + 1]; p++) sum += out.row[p];
        sphi_put(out.diagonal, stride, i, -sum);
    }
    sphi_put(out.factor, stride, i, SPH_R(1));
    sphi_put(out.conditioning, stride, i, conditioning);
    if (out.status) out.status[i] = (unsigned char)state;
}

/* What a check found: 0, as a rule. Without the word gcc takes the loops behind twenty checks for loops
   that hardly ever run, and does not vectorise them. */
#if defined(__GNUC__) && __GNUC__ >= 9 && !defined(__clang__) && !SPH_OPENCL && \
    !(defined(__CUDACC__) || defined(__INTEL_COMPILER) || defined(__NVCOMPILER))
#  define SPHI_RARELY(error) ((int)__builtin_expect_with_probability(error, 0, 1.0))
#else
#  define SPHI_RARELY(error) (error)
#endif

/* Calls SPH_REFUSED with the name of an argument, the first particle at fault (-1: no particle) and the
   error, and returns the error. */
SPH_FN int sphi_refuse(SPHI_TEXT *argument, sph_index particle, int error)
{
    (void)argument;
    (void)particle;
    SPH_REFUSED(argument, particle, error);
    return error;
}
/* Checks that know the targets may also return this: there are none, so that nothing else is looked at. */
enum { SPHI_NO_TARGETS = 1 };
/* What a sweep returns if a check returned this: the sph_error, or 0 if there are no targets. */
SPH_FN int sphi_answer_of(int error) { return error < 0 ? error : 0; }

/* Scans of arrays: the values must be finite, positive, or not negative. They make two passes: the first asks
   whether there is a fault, and vectorises; the second finds the place. */
SPHI_LARGE int sphi_scan_finite(SPHI_TEXT *name, sph_scalars a, sph_index n, int error)
{
    const sph_index count = a.stride ? n : 1;
    sph_index i;
    int bad = 0;
    for (i = 0; i < count; i++) bad |= !sphi_finite(sphi_at(a, i));
    if (!bad) return 0;
    for (i = 0; sphi_finite(sphi_at(a, i));) i++;
    return sphi_refuse(name, i, error);
}
SPHI_LARGE int sphi_scan_positive(SPHI_TEXT *name, sph_scalars a, sph_index n)
{
    const sph_index count = a.stride ? n : 1;
    sph_index i;
    int bad = 0;
    for (i = 0; i < count; i++) bad |= !(sphi_at(a, i) > SPH_R(0));
    if (!bad) return 0;
    for (i = 0; sphi_at(a, i) > SPH_R(0);) i++;
    return sphi_refuse(name, i, SPH_ERROR_VALUE);
}
SPHI_LARGE int sphi_scan_not_negative(SPHI_TEXT *name, sph_scalars a, sph_index n)
{
    const sph_index count = a.stride ? n : 1;
    sph_index i;
    int bad = 0;
    for (i = 0; i < count; i++) bad |= sphi_at(a, i) < SPH_R(0);
    if (!bad) return 0;
    for (i = 0; !(sphi_at(a, i) < SPH_R(0));) i++;
    return sphi_refuse(name, i, SPH_ERROR_VALUE);
}
/* Smoothing lengths or radii must be finite and positive. *largest is raised to the largest of them. */
SPHI_LARGE int sphi_scan_h(SPHI_TEXT *name, sph_scalars h, sph_index n, sph_real *largest)
{
    const sph_index count = h.stride ? n : 1;
    sph_index i;
    for (i = 0; i < count; i++) {
        const sph_real h_i = sphi_at(h, i);
        if (!sphi_finite(h_i) || !(h_i > SPH_R(0))) return sphi_refuse(name, i, SPH_ERROR_H);
        if (h_i > *largest) *largest = h_i;
    }
    return 0;
}
/* Coordinates must be finite, and so must the difference of any two. */
SPHI_LARGE int sphi_scan_places(SPHI_TEXT *name, const SPH_GLOBAL sph_real *x, size_t stride, sph_index n)
{
    sph_index i;
    int bad = 0;
    for (i = 0; i < n; i++) bad |= !sphi_finite(SPH_R(2) * x[(size_t)i * stride]);
    if (!bad) return 0;
    for (i = 0; sphi_finite(SPH_R(2) * x[(size_t)i * stride]);) i++;
    return sphi_refuse(name, i, SPH_ERROR_POSITION);
}
/* Coordinates on a periodic axis must be so small that the images can be counted in 32 bits: at most 2^20
   lengths. */
SPHI_LARGE int sphi_scan_images(sph_real length, const SPH_GLOBAL sph_real *x, size_t stride, sph_index n)
{
    const sph_real furthest = SPH_R(1048576) * length;
    sph_index i;
    int outside = 0;
    for (i = 0; i < n; i++) outside |= !(SPHI_ABS(x[(size_t)i * stride]) <= furthest);
    if (!outside) return 0;
    for (i = 0; SPHI_ABS(x[(size_t)i * stride]) <= furthest;) i++;
    return sphi_refuse("points", i, SPH_ERROR_BOX);
}
/* gcc -O2 vectorises loops of constant length only, and no loop that it has unrolled. So it scans entries
   SPHI_SCAN abreast. Others do better with a plain loop. */
#if defined(__GNUC__) && __GNUC__ >= 8 && !defined(__clang__) && \
    !(defined(__CUDACC__) || defined(__INTEL_COMPILER) || defined(__NVCOMPILER))
#  define SPHI_SCAN 8
#  define SPHI_SCAN_LANES SPHI_PRAGMA(GCC unroll 1)
#else
#  define SPHI_SCAN 1
#  define SPHI_SCAN_LANES
#endif
/* The lists of the targets first ... last - 1 must be in order, with entries 0 ... n - 1. If foreign is 0,
   the targets are themselves among these n sources, and none may be in its own list. */
SPHI_LARGE int sphi_scan_entries(sph_index first, sph_index last, sph_list list, sph_index n, int foreign)
{
    sph_index i, p, bad[SPHI_SCAN];
    int c, outside, any = 0;
    for (i = first; i < last; i++)
        if (list.start[i + 1] < list.start[i]) return sphi_refuse("list", i, SPH_ERROR_LIST);
    for (c = 0; c < SPHI_SCAN; c++) bad[c] = 0;
    for (i = first; i < last; i++) {
        const sph_index end = list.start[i + 1], self = foreign ? (sph_index)-1 : i;
        for (p = list.start[i]; end - p >= SPHI_SCAN; p = (sph_index)(p + SPHI_SCAN)) {
            SPHI_SCAN_LANES
            for (c = 0; c < SPHI_SCAN; c++) {
                const sph_index j = list.index[p + c];
                bad[c] = (sph_index)(bad[c] | ((j < 0) | (j >= n) | (j == self)));
            }
        }
        for (; p < end; p++) {
            const sph_index j = list.index[p];
            bad[0] = (sph_index)(bad[0] | ((j < 0) | (j >= n) | (j == self)));
        }
    }
    for (c = 0; c < SPHI_SCAN; c++) any |= (int)bad[c];
    for (outside = 1; any && outside >= 0; outside--)
        for (i = first; i < last; i++)
            for (p = list.start[i]; p < list.start[i + 1]; p++) {
                const sph_index j = list.index[p];
                if (outside ? j < 0 || j >= n : j == i)
                    return sphi_refuse("list", i, outside ? (int)SPH_ERROR_LIST : (int)SPH_ERROR_SELF);
            }
    return 0;
}

/* Checks an axis of the box. Its length must not be negative, the largest support must not reach beyond half
   of it, and the images of positions must be countable in 32 bits (unless a scan has found that before). */
SPH_FN int sphi_check_axis(sph_real length, sph_real largest, const SPH_GLOBAL sph_real *x, size_t stride,
                           sph_index n, int scanned)
{
    if (!sphi_finite(length) || length < SPH_R(0)) return sphi_refuse("box", -1, SPH_ERROR_BOX);
    if (!(length > SPH_R(0))) return 0;
    /* The inverse of a denormal length overflows. */
    if (!sphi_finite(SPH_R(1) / length)) return sphi_refuse("box", -1, SPH_ERROR_BOX);
    /* There is room for rounding, because a host may have computed h from half the box. */
    if (!(largest <= SPH_R(0.5) * length * (SPH_R(1) + SPH_R(4) * SPH_EPSILON)))
        return sphi_refuse("box", -1, SPH_ERROR_BOX);
    return SPH_CHECK && !scanned ? SPHI_RARELY(sphi_scan_images(length, x, stride, n)) : 0;
}
SPH_FN int sphi_check_box(int dim, sph_points x, sph_real largest, int scanned)
{
    int error = sphi_check_axis(x.box.x, largest, x.x, x.stride, x.n, scanned);
    if (!error && dim > 1) error = sphi_check_axis(x.box.y, largest, x.y, x.stride, x.n, scanned);
    if (!error && dim > 2) error = sphi_check_axis(x.box.z, largest, x.z, x.stride, x.n, scanned);
    return error;
}

/* The arrays of positions must be there, with a stride of at least 1. */
SPH_FN int sphi_check_arrays(int dim, sph_points x)
{
    if (!x.x || (dim > 1 && !x.y) || (dim > 2 && !x.z)) return sphi_refuse("points", -1, SPH_ERROR_NULL);
    return x.stride < 1 ? sphi_refuse("points.stride", -1, SPH_ERROR_COUNT) : 0;
}
/* What all sweeps over clouds check: the dimension, the mark of sph_cloud_checked, and the range of targets.
   Returns SPHI_NO_TARGETS if the range is empty. */
SPH_FN int sphi_check_targets(int dim, sph_cloud cloud)
{
    if (dim < 1 || dim > 3) return sphi_refuse("dim", -1, SPH_ERROR_DIM);
    if (cloud.checked < 0) return cloud.checked;
    if (cloud.points.n < 0) return sphi_refuse("points.n", -1, SPH_ERROR_COUNT);
    if (cloud.first < 0 || cloud.first > cloud.last || cloud.last > cloud.points.n)
        return sphi_refuse("first, last", -1, SPH_ERROR_RANGE);
    return cloud.first == cloud.last ? SPHI_NO_TARGETS : 0;
}
/* The same, and the arrays of positions and lists must be there. */
SPH_FN int sphi_check_frame(int dim, sph_cloud cloud)
{
    int error = sphi_check_targets(dim, cloud);
    if (!error) error = sphi_check_arrays(dim, cloud.points);
    return error || cloud.list.start ? error : sphi_refuse("list", -1, SPH_ERROR_NULL);
}
SPH_FN int sphi_check_positions(int dim, sph_points x)
{
    int error = SPH_CHECK ? sphi_scan_places("x", x.x, x.stride, x.n) : 0;
    if (SPH_CHECK && !error && dim > 1) error = sphi_scan_places("y", x.y, x.stride, x.n);
    if (SPH_CHECK && !error && dim > 2) error = sphi_scan_places("z", x.z, x.stride, x.n);
    return SPHI_RARELY(error);
}
/* The lists of the targets first ... last - 1, as for sphi_scan_entries. Without SPH_CHECK only the two ends
   of the range are looked at. */
SPH_FN int sphi_check_entries(sph_index first, sph_index last, sph_list list, sph_index n, int foreign)
{
    if (first == last) return 0;
    if (list.start[first] < 0 || list.start[last] < list.start[first])
        return sphi_refuse("list", first, SPH_ERROR_LIST);
    if (list.start[last] > list.start[first] && !list.index) return sphi_refuse("list", -1, SPH_ERROR_NULL);
    return SPH_CHECK ? SPHI_RARELY(sphi_scan_entries(first, last, list, n, foreign)) : 0;
}
/* The positions, the box for sums that reach as far as `largest`, and the lists of the targets. */
SPH_FN int sphi_check_scan(int dim, sph_cloud cloud, sph_real largest)
{
    const int scanned = cloud.checked == 1;
    int error = scanned ? 0 : sphi_check_positions(dim, cloud.points);
    if (!error) error = sphi_check_box(dim, cloud.points, largest, scanned);
    if (error || scanned) return error;
    return sphi_check_entries(cloud.first, cloud.last, cloud.list, cloud.points.n, 0);
}
/* For sweeps without a kernel, whose lists reach as far as `distance`. */
SPH_FN int sphi_check_list(int dim, sph_cloud cloud, sph_real distance)
{
    const int error = sphi_check_frame(dim, cloud);
    return error ? error : sphi_check_scan(dim, cloud, distance);
}
SPH_FN int sphi_check_h(SPHI_TEXT *name, sph_scalars h, sph_index n, sph_real *largest)
{
    return SPH_CHECK ? SPHI_RARELY(sphi_scan_h(name, h, n, largest)) : 0;
}
/* Values that are there must be finite; nothing else is asked of them. */
SPH_FN int sphi_check_finite(SPHI_TEXT *name, sph_scalars a, sph_index n, int error)
{
    return SPH_CHECK ? SPHI_RARELY(sphi_scan_finite(name, a, n, error)) : 0;
}
SPH_FN int sphi_check_kernel(sph_kernel k)
{
    return (unsigned)k >= (unsigned)SPH_KERNEL_COUNT ? sphi_refuse("kernel", -1, SPH_ERROR_KERNEL) : 0;
}
SPH_FN int sphi_check_field(SPHI_TEXT *name, sph_scalars f, sph_index n)
{
    return SPHI_RARELY(f.p ? sphi_check_finite(name, f, n, SPH_ERROR_VALUE)
                           : sphi_refuse(name, -1, SPH_ERROR_NULL));
}
/* For sweeps with a kernel: the same, the kernel, h, and the weights of n particles. */
SPH_FN int sphi_check_weights(sph_kernel k, int dim, sph_cloud cloud, SPHI_TEXT *name, sph_scalars weights,
                              sph_index n)
{
    const int scanned = cloud.checked == 1;
    sph_real largest = scanned ? cloud.largest_h : SPH_R(0); /* 0: there was no h when it was scanned */
    int error = sphi_check_frame(dim, cloud);
    if (error >= 0 && sphi_check_kernel(k)) return SPH_ERROR_KERNEL;
    if (!error && !cloud.h.p) error = sphi_refuse("h", -1, SPH_ERROR_NULL);
    if (!error && !weights.p) error = sphi_refuse(name, -1, SPH_ERROR_NULL);
    if (!error && !(largest > SPH_R(0))) error = sphi_check_h("h", cloud.h, cloud.points.n, &largest);
    if (!error && !(scanned && weights.p == cloud.volume.p && weights.stride == cloud.volume.stride))
        error = sphi_check_finite(name, weights, n, SPH_ERROR_VALUE);
    return error ? error : sphi_check_scan(dim, cloud, sph_kernel_support_ratio(k) * largest);
}
/* The weights are those of the neighbours: volumes or masses. */
SPH_FN int sphi_check_sweep(sph_kernel k, int dim, sph_cloud cloud, SPHI_TEXT *name, sph_scalars weights)
{
    return sphi_check_weights(k, dim, cloud, name, weights, cloud.points.n);
}
/* Where a vector goes: its first dim arrays must be there. To be called after the checks of the sweep. */
SPH_FN int sphi_check_out(SPHI_TEXT *name, int dim, sph_vector_out out)
{
    const int there = out.x && (dim < 2 || out.y) && (dim < 3 || out.z);
    return SPHI_RARELY(there ? 0 : sphi_refuse(name, -1, SPH_ERROR_NULL));
}

SPH_FN int sphi_check_matrix_out(SPHI_TEXT *name, int dim, sph_matrix_out out)
{
    int error = sphi_check_out(name, dim, out.x);
    if (!error && dim > 1) error = sphi_check_out(name, dim, out.y);
    return error || dim < 3 ? error : sphi_check_out(name, dim, out.z);
}

/* Scans positions and box once, and lists, h and volumes if the cloud has them. It returns the cloud with a
   mark, so that sweeps scan only what else they read. Call it again when something changes. If something is
   wrong, the mark is the sph_error, and every sweep answers it. */
SPH_FN sph_cloud sph_cloud_checked(int dim, sph_cloud cloud)
{
    int error;
    cloud.checked = 0;
    cloud.largest_h = SPH_R(0);
    error = sphi_check_targets(dim, cloud);
    if (!error) error = sphi_check_arrays(dim, cloud.points);
    if (!error) error = sphi_check_positions(dim, cloud.points);
    if (!error) error = sphi_check_box(dim, cloud.points, SPH_R(0), 0);
    if (!error && cloud.list.start)
        error = sphi_check_entries(cloud.first, cloud.last, cloud.list, cloud.points.n, 0);
    if (!error && cloud.h.p) error = sphi_check_h("h", cloud.h, cloud.points.n, &cloud.largest_h);
    if (!error && cloud.volume.p)
        error = sphi_check_finite("volume", cloud.volume, cloud.points.n, SPH_ERROR_VALUE);
    cloud.checked = error < 0 ? error : !error;
    return cloud;
}

/* Whether a state means that there is no answer. */
SPH_FN int sphi_unanswered(int state)
{
    return state == SPH_TOO_FEW || state == SPH_SINGULAR || state == SPH_NOT_AVAILABLE ||
           state == SPH_NOT_FINITE;
}

/* The reason why a system was singular: SPH_TOO_FEW if fewer than `needed` neighbours are inside the support
   (coincident ones do not count), else SPH_SINGULAR. */
SPH_FN int sphi_singular_status(sph_kernel k, int dim, sph_index i, sph_points x, sph_list list, sph_real h,
                                int needed)
{
    const sph_vec x_i = sphi_point(dim, x, i);
    const sph_real support = sph_kernel_support_ratio(k) * h;
    sph_index p;
    int count = 0;
    for (p = list.start[i]; p < list.start[i + 1]; p++) {
        const sph_real r = sph_length(dim, sphi_separation(dim, x, x_i, sphi_point(dim, x, list.index[p])));
        count += r > SPH_R(0) && r < support;
        if (count >= needed) return SPH_SINGULAR;
    }
    return SPH_TOO_FEW;
}

SPH_FN sph_vec sphi_vector_at(int dim, sph_vectors v, sph_index i)
{
    sph_vec a;
    a.x = sphi_at(v.x, i);
    a.y = dim > 1 ? sphi_at(v.y, i) : SPH_R(0);
    a.z = dim > 2 ? sphi_at(v.z, i) : SPH_R(0);
    return a;
}
SPH_FN int sphi_check_vectors(SPHI_TEXT *name, int dim, sph_vectors v, sph_index n)
{
    int error = sphi_check_field(name, v.x, n);
    if (!error && dim > 1) error = sphi_check_field(name, v.y, n);
    if (!error && dim > 2) error = sphi_check_field(name, v.z, n);
    return SPHI_RARELY(error);
}
SPH_FN sph_mat sphi_matrix_at(int dim, sph_matrices m, sph_index i)
{
    sph_mat a;
    a.x = sphi_vector_at(dim, m.x, i);
    a.y = dim > 1 ? sphi_vector_at(dim, m.y, i) : sph_scale(SPH_R(0), a.x);
    a.z = dim > 2 ? sphi_vector_at(dim, m.z, i) : sph_scale(SPH_R(0), a.x);
    return a;
}
SPH_FN int sphi_check_matrices(SPHI_TEXT *name, int dim, sph_matrices m, sph_index n)
{
    int error = sphi_check_vectors(name, dim, m.x, n);
    if (!error && dim > 1) error = sphi_check_vectors(name, dim, m.y, n);
    if (!error && dim > 2) error = sphi_check_vectors(name, dim, m.z, n);
    return SPHI_RARELY(error);
}
SPH_FN int sphi_check_positive(SPHI_TEXT *name, sph_scalars a, sph_index n)
{
    const int error = sphi_check_field(name, a, n);
    if (error) return error;
    return SPH_CHECK ? SPHI_RARELY(sphi_scan_positive(name, a, n)) : 0;
}
SPH_FN int sphi_check_not_negative(SPHI_TEXT *name, sph_scalars a, sph_index n)
{
    const int error = sphi_check_field(name, a, n);
    if (error) return error;
    return SPH_CHECK ? SPHI_RARELY(sphi_scan_not_negative(name, a, n)) : 0;
}

/* ================================================================ small systems
 *
 * Dense systems a x = b of at most 6 equations, by a = L U with partial pivoting. Rows are stored 6 apart.
 */

enum { SPHI_MAX = 6 };
typedef struct sphi_lu {
    sph_real a[SPHI_MAX][SPHI_MAX]; /* before: the matrix. After: U, above the diagonal */
    sph_real lower[SPHI_MAX][SPHI_MAX], inverse[SPHI_MAX]; /* L below its diagonal of ones; 1 / pivots */
    int row[SPHI_MAX];
    /* The smallest |pivot| measures the singularity, because the matrices come scaled to a unit diagonal. */
    sph_real pivot_min;
    sph_real sign; /* sign of the determinant */
} sphi_lu;

/* A pivot below this is rounding error, because the entries of the matrix are of order one. */
#define SPHI_PIVOT_MIN (SPH_R(64) * SPH_EPSILON)

/* Exchanges two rows of n numbers. */
SPH_FN void sphi_exchange(int n, sph_real *a, sph_real *b)
{
    int j;
    for (j = 0; j < n; j++) {
        const sph_real t = a[j];
        a[j] = b[j];
        b[j] = t;
    }
}
/* Factors s->a in place. A pivot below SPHI_PIVOT_MIN is replaced by it, so that solutions stay finite and
   show the null direction. Rows are subtracted whole, also where they are 0 by then, and a copy is
   subtracted: so the loops over a row vectorise. */
SPH_FN void sphi_lu_factor(int n, sphi_lu *s)
{
    int i, j, c;
    s->pivot_min = SPH_R(1);
    s->sign = SPH_R(1);
    for (c = 0; c < n; c++) {
        int best = c;
        sph_real p = SPHI_ABS(s->a[c][c]), pivot_row[SPHI_MAX];
        for (i = c + 1; i < n; i++) {
            const sph_real size = SPHI_ABS(s->a[i][c]);
            best = size > p ? i : best;
            p = size > p ? size : p;
        }
        s->row[c] = best;
        if (best != c) {
            s->sign = -s->sign;
            sphi_exchange(n, s->a[c], s->a[best]);
            sphi_exchange(c, s->lower[c], s->lower[best]);
        }
        if (!(p >= s->pivot_min)) s->pivot_min = p;
        if (s->a[c][c] < SPH_R(0)) s->sign = -s->sign;
        if (!(p >= SPHI_PIVOT_MIN)) s->a[c][c] = s->a[c][c] < SPH_R(0) ? -SPHI_PIVOT_MIN : SPHI_PIVOT_MIN;
        p = s->inverse[c] = SPH_R(1) / s->a[c][c];
        for (j = 0; j < n; j++) pivot_row[j] = s->a[c][j];
        for (i = c + 1; i < n; i++) {
            const sph_real m = s->lower[i][c] = s->a[i][c] * p;
            for (j = 0; j < n; j++) s->a[i][j] -= m * pivot_row[j];
        }
    }
}
/* Solves a x = b for `columns` right-hand sides (1 to SPHI_MAX), which are stored side by side; x replaces
   b. */
SPH_FN void sphi_lu_solve_columns(int n, const sphi_lu *s, int columns, sph_real *b)
{
    sph_real x[SPHI_MAX];
    int i, j, l;
    for (i = 0; i < n; i++)
        if (s->row[i] != i) sphi_exchange(columns, b + i * columns, b + s->row[i] * columns);
    for (j = 0; j < n - 1; j++) {
        for (l = 0; l < columns; l++) x[l] = b[j * columns + l];
        for (i = j + 1; i < n; i++)
            for (l = 0; l < columns; l++) b[i * columns + l] -= s->lower[i][j] * x[l];
    }
    for (j = n - 1; j >= 0; j--) {
        for (l = 0; l < columns; l++) x[l] = b[j * columns + l] *= s->inverse[j];
        for (i = 0; i < j; i++)
            for (l = 0; l < columns; l++) b[i * columns + l] -= s->a[i][j] * x[l];
    }
}
/* Solves a x = b; x replaces b. */
SPH_FN void sphi_lu_solve(int n, const sphi_lu *s, sph_real *b) { sphi_lu_solve_columns(n, s, 1, b); }
/* y = m x, and y = m^T x, where m has the shape rows x cols. */
SPH_FN void sphi_multiply(int rows, int cols, sph_real (*m)[SPHI_MAX], const sph_real *x, sph_real *y)
{
    int i, j;
    for (i = 0; i < rows; i++) {
        y[i] = SPH_R(0);
        for (j = 0; j < cols; j++) y[i] += m[i][j] * x[j];
    }
}
SPH_FN void sphi_multiply_transposed(int rows, int cols, sph_real (*m)[SPHI_MAX], const sph_real *x,
                                     sph_real *y)
{
    int i, j;
    for (j = 0; j < cols; j++) {
        y[j] = SPH_R(0);
        for (i = 0; i < rows; i++) y[j] += m[i][j] * x[i];
    }
}

/* ================================================================ interpolation and density
 *
 * Interpolation needs no formula beyond V_j W_ij and V_j f_j W_ij.
 *
 * With q = r_ij / h_i and W = sigma / h^dim w(q), density and smoothing length need two sums over the
 * neighbours and the particle itself (q = 0):
 *     S        = sum_j m_j w(q),
 *     T        = -sum_j m_j q w'(q),   T >= 0 for kernels that fall monotonically,
 *     rho      = sigma / h^dim S,
 *     d rho/dh = (rho / h) (T / S - dim),
 *     Omega    = 1 + h / (dim rho) d rho/dh = T / (dim S).
 * The relation h = eta (m / rho)^(1/dim) is the same as sigma S / m = eta^dim. If the masses are positive and
 * the kernel falls monotonically, the left side only grows with h: it begins at sigma w(0), or higher where
 * other particles coincide with this one, and ends at sigma w(0) sum_j m_j / m. So there is one solution at
 * most, and none if eta^dim lies outside this range.
 * Omega is near 1 where the density is uniform, above 1 where it rises with the distance from the particle,
 * and 0 for a particle without neighbours.
 *
 * Sources: Springel & Hernquist 2002, MNRAS 333, 649 (their f_i is 1 / Omega); Price & Monaghan 2004,
 * MNRAS 348, 139 (Omega = 1 - dh/drho sum_j m_j dW_ij(h_i)/dh_i with dh/drho = -h / (dim rho)); Price 2012,
 * JCP 231, 759, (10) (the relation of h and rho).
 */

/* The sums S and T. */
typedef struct sph_density_sums {
    sph_real weight, slope;
} sph_density_sums;

/* What a neighbour at q = r / h adds to S and T: m_j w(q) and -m_j q w'(q). The particle itself has q = 0.
   Needs q >= 0. */
SPH_FN sph_density_sums sph_density_pair(sph_kernel k, int dim, sph_real q, sph_real m_j)
{
    sph_density_sums c;
    c.weight = m_j * sph_kernel_shape(k, dim, q);
    c.slope = -m_j * q * q * sph_kernel_shape_f(k, dim, q);
    return c;
}
/* rho = sigma / h^dim S. Its unit is mass / length^dim. */
SPH_FN sph_real sph_density_value(sph_kernel k, int dim, sph_density_sums s, sph_real h)
{
    SPH_ASSERT(h > SPH_R(0));
    return sph_kernel_sigma(k, dim) * sphi_power(SPH_R(1) / h, dim) * s.weight;
}
/* Omega = T / (dim S), without unit. This form takes no difference of nearly equal numbers, however few the
   neighbours are. Needs S > 0. */
SPH_FN sph_real sph_density_omega(int dim, sph_density_sums s)
{
    SPH_ASSERT(SPHI_IS_DIM(dim) && s.weight > SPH_R(0));
    return s.slope / (SPH_R(dim) * s.weight);
}
/* ln(eta (m / rho)^(1/dim) / h). It is 0 for the h that belongs to rho, and positive where h is too short.
   Its derivative by ln h is -Omega. Needs S > 0, m > 0 and eta > 0. */
SPH_FN sph_real sph_density_mismatch(sph_kernel k, int dim, sph_density_sums s, sph_real m, sph_real eta)
{
    SPH_ASSERT(s.weight > SPH_R(0) && m > SPH_R(0) && eta > SPH_R(0));
    return SPHI_LOG(eta) - SPHI_LOG(sph_kernel_sigma(k, dim) * s.weight / m) / SPH_R(dim);
}

/* -------- interpolation: sweeps */

/* sum_j w_j W_ij, the particle itself included. The weights w are volumes or masses. */
SPH_FN sph_index sphi_sum_of_weights(sph_kernel k, int dim, sph_cloud cloud, SPHI_TEXT *name,
                                     sph_scalars weights, sph_scalar_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, name, weights);
    sph_index i, p, failed = 0;
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real sum = sphi_at(weights, i) * sph_kernel_w(k, dim, SPH_R(0), h_i);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum) {
            const sph_index j = cloud.list.index[p];
            sum += sphi_at(weights, j) *
                   sph_kernel_w(k, dim,
                                sph_length(dim, sphi_separation(dim, cloud.points, x_i,
                                                                sphi_point(dim, cloud.points, j))),
                                h_i);
        }
        failed += sphi_store(out, i, sum);
    }
    return failed;
}
/* gamma_i = sum_j V_j W_ij, the particle itself included. It is 1 in the interior of a regular cloud, and
   about 1/2 at a plane boundary. Sources: Shepard 1968; (4.10) of the ICSPM paper (see second derivatives).
   Where the sum overflows, the result is 0 and SPH_NOT_FINITE. */
SPH_FN sph_index sph_shepard_sum(sph_kernel k, int dim, sph_cloud cloud, sph_scalar_out out)
{
    return sphi_sum_of_weights(k, dim, cloud, "volume", cloud.volume, out);
}

/* f_i = sum_j V_j f_j W_ij / sum_j V_j W_ij, the particle itself included. It is exact for constants; the
   error is O(h^2) in the interior of a regular cloud, and O(h) in disorder and at a boundary. Shepard 1968. A
   target of volume 0 is a probe. The result is 0 where the sum of weights is not positive (SPH_TOO_FEW) or a
   sum overflows (SPH_NOT_FINITE).
   Atlas: value exact for constants, inside lattices for linear fields; order 2 inside lattices, 1 in
   disorder, 1 at boundaries. */
SPH_FN sph_index sph_interpolate_shepard(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                         sph_scalar_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i),
                       own = sphi_at(cloud.volume, i) * sph_kernel_w(k, dim, SPH_R(0), h_i);
        sph_real sum = own, sum_f = own * sphi_at(f, i);
        int state = SPH_OK;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum, sum_f) {
            const sph_index j = cloud.list.index[p];
            const sph_real w =
                sphi_at(cloud.volume, j) *
                sph_kernel_w(k, dim,
                             sph_length(dim, sphi_separation(dim, cloud.points, x_i,
                                                             sphi_point(dim, cloud.points, j))),
                             h_i);
            sum += w;
            sum_f += w * sphi_at(f, j);
        }
        if (!(sum > SPH_R(0))) state = SPH_TOO_FEW;
        else if (!sphi_finite(sum_f / sum)) state = SPH_NOT_FINITE;
        failed += sphi_answer(out, i, state ? SPH_R(0) : sum_f / sum, state);
    }
    return failed;
}

/* -------- density: sweeps */

/* rho_i = sum_j m_j W_ij(h_i), the particle itself included (a probe has the mass 0). The error is O(h^2) in
   the interior of a regular cloud, down to what h / dx leaves (0.1 % for wendland-c2 and h = 2 dx in 2D), and
   about rho / 2 at a free surface. h is given here; sph_density_adaptive finds an h that follows rho. Where
   the sum overflows, the result is 0 and SPH_NOT_FINITE.
   Atlas: value exact for nothing; order 0 inside lattices, 0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_density_summation(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                       sph_scalar_out out)
{
    return sphi_sum_of_weights(k, dim, cloud, "m", m, out);
}

/* S and T of target i at the smoothing length h_i. */
SPH_FN sph_density_sums sphi_density_sums(sph_kernel k, int dim, sph_index i, sph_points x, sph_list list,
                                          sph_real h_i, sph_scalars m)
{
    const sph_vec x_i = sphi_point(dim, x, i);
    const sph_real u = SPH_R(1) / h_i;
    sph_density_sums sums = sph_density_pair(k, dim, SPH_R(0), sphi_at(m, i));
    sph_real weight = sums.weight, slope = sums.slope;
    sph_index p;
    SPH_SUM(p, list.start[i], list.start[i + 1], weight, slope) {
        const sph_index j = list.index[p];
        const sph_density_sums c = sph_density_pair(
            k, dim, u * sph_length(dim, sphi_separation(dim, x, x_i, sphi_point(dim, x, j))), sphi_at(m, j));
        weight += c.weight;
        slope += c.slope;
    }
    sums.weight = weight;
    sums.slope = slope;
    return sums;
}

/* An h that is just so short that only coincident neighbours are inside the support. It is 0 if there are no
   other neighbours. */
SPH_FN sph_real sphi_density_h_alone(sph_kernel k, int dim, sph_index i, sph_points x, sph_list list)
{
    const sph_vec x_i = sphi_point(dim, x, i);
    sph_real nearest = SPH_R(0);
    sph_index p;
    for (p = list.start[i]; p < list.start[i + 1]; p++) {
        const sph_real r = sph_length(dim, sphi_separation(dim, x, x_i, sphi_point(dim, x, list.index[p])));
        if (r > SPH_R(0) && (!(nearest > SPH_R(0)) || r < nearest)) nearest = r;
    }
    return nearest / sph_kernel_support_ratio(k) * (SPH_R(1) - SPH_R(8) * SPH_EPSILON);
}

/* Newton's method in ln h. It is exact in one step where rho h^dim is a power of h. The bounds low < root <=
   high are kept as far as they are known (0: not yet). A step is replaced if it leaves the bounds, or if the
   step before did not halve the mismatch: by the longest h while there is no upper bound, by the shortest h
   that can matter while there is no lower bound, else by bisection in ln h. A mismatch can be halved at most
   64 times, and bounds as far apart as numbers can be meet after at most 64 bisections: hence the number of
   steps. */
enum { SPHI_DENSITY_STEPS = 130 };
SPH_FN int sphi_density_solve(sph_kernel k, int dim, sph_index i, sph_points x, sph_list list,
                              sph_real longest, sph_scalars m, sph_real eta, sph_real tolerance,
                              SPH_GLOBAL sph_real *h, sph_density_sums *sums)
{
    sph_real at = *h < longest ? *h : longest, low = SPH_R(0), high = SPH_R(0), least = SPH_R(-1);
    int step;
    for (step = 0; step < (int)SPHI_DENSITY_STEPS; step++) {
        sph_real mismatch = SPH_R(1), next = SPH_R(0);
        *sums = sphi_density_sums(k, dim, i, x, list, at, m);
        *h = at;
        if (!sphi_finite(sums->weight) || !sphi_finite(sums->slope)) return SPH_NOT_FINITE;
        /* If negative lobes or masses outweigh the rest, h counts as too short. */
        if (sums->weight > SPH_R(0)) {
            mismatch = sph_density_mismatch(k, dim, *sums, sphi_at(m, i), eta);
            if (!sphi_finite(mismatch)) return SPH_NOT_FINITE;
            if (SPHI_ABS(SPHI_EXP(mismatch) - SPH_R(1)) <= tolerance) return SPH_OK;
        }
        if (mismatch > SPH_R(0)) {
            if (!(at < longest)) return SPH_LIST_TOO_SHORT;
            low = at;
        } else {
            if (!(SPHI_ABS(sums->slope) > SPH_R(0))) return SPH_SINGULAR;
            high = at;
        }
        if (low > SPH_R(0) && high > SPH_R(0) && !(high - low > SPH_R(4) * SPH_EPSILON * high))
            return SPH_ILL_CONDITIONED;
        if (sums->weight > SPH_R(0) && sums->slope > SPH_R(0) &&
            (least < SPH_R(0) || SPHI_ABS(mismatch) <= SPH_R(0.5) * least)) {
            const sph_real e = mismatch / sph_density_omega(dim, *sums);
            least = SPHI_ABS(mismatch);
            if (SPHI_ABS(e) < SPH_R(40)) next = at * SPHI_EXP(e);
            if (!(next > low && next < (high > SPH_R(0) ? high : longest))) next = SPH_R(0);
        }
        if (!(next > SPH_R(0))) {
            if (!(high > SPH_R(0))) next = longest;
            else if (low > SPH_R(0)) next = SPHI_SQRT(low) * SPHI_SQRT(high);
            else next = sphi_density_h_alone(k, dim, i, x, list);
        }
        if (!(next > SPH_R(0))) return SPH_SINGULAR;
        at = next;
    }
    return SPH_ILL_CONDITIONED;
}

/* For a target whose h would have to be longer than the list allows. Returns SPH_LIST_TOO_SHORT, and in *h
   the one to build the next list for; or SPH_TOO_FEW if no list could help. */
SPH_FN int sphi_density_longer(sph_kernel k, int dim, sph_index i, sph_points x, sph_list list, sph_scalars m,
                               sph_real eta, sph_density_sums sums, SPH_GLOBAL sph_real *h)
{
    sph_real longest = SPH_R(0), grow = SPH_R(2);
    sph_index p;
    if (x.box.x > SPH_R(0)) longest = x.box.x;
    if (dim > 1 && x.box.y > SPH_R(0) && !(longest > SPH_R(0) && longest < x.box.y)) longest = x.box.y;
    if (dim > 2 && x.box.z > SPH_R(0) && !(longest > SPH_R(0) && longest < x.box.z)) longest = x.box.z;
    longest *= SPH_R(0.5) / sph_kernel_support_ratio(k);
    if (longest > SPH_R(0)) {
        if (!(*h < longest * (SPH_R(1) - SPH_R(8) * SPH_EPSILON))) return SPH_TOO_FEW;
    } else if (list.start[i + 1] - list.start[i] >= x.n - 1) {
        /* The list is the whole cloud: would all its mass at the distance 0 be enough? */
        sph_density_sums all = sph_density_pair(k, dim, SPH_R(0), sphi_at(m, i));
        for (p = list.start[i]; p < list.start[i + 1]; p++)
            all.weight += sph_density_pair(k, dim, SPH_R(0), sphi_at(m, list.index[p])).weight;
        if (!(all.weight > SPH_R(0)) || !(sph_density_mismatch(k, dim, all, sphi_at(m, i), eta) < SPH_R(0)))
            return SPH_TOO_FEW;
    }
    if (sums.weight > SPH_R(0) && sums.slope > SPH_R(0)) {
        const sph_real e =
            sph_density_mismatch(k, dim, sums, sphi_at(m, i), eta) / sph_density_omega(dim, sums);
        /* An h that is a little too short again would cost another list: hence the margin. */
        if (e < SPH_R(0.6)) grow = SPH_R(1.05) * SPHI_EXP(e);
    }
    if (!sphi_finite(*h * grow)) return SPH_TOO_FEW;
    *h = longest > SPH_R(0) && *h * grow > longest ? longest : *h * grow;
    return SPH_LIST_TOO_SHORT;
}

typedef struct sph_density_options {
    sph_scalars list_radius; /* of the targets: list i holds all sources with r < list_radius_i; no default */
    sph_real eta;            /* h = eta (m / rho)^(1/dim); 0: sph_kernel_h_over_dx(k) */
    sph_real tolerance;      /* relative, of h, below 1; 0: 1e-3. At least 64 unit round-offs are used */
} sph_density_options;
/* h holds the guess, and then the answer. omega and status may be null. The stride is that of h, rho and
   omega. */
typedef struct sph_density_out {
    SPH_GLOBAL sph_real *h, *rho, *omega;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_density_out;

/* Density and smoothing length that belong together, and the factor Omega of the equations of motion with
   that h (sources: see the beginning of this chapter). The particle itself is in all sums:
       h_i     = eta (m_i / rho_i)^(1/dim)   to   |eta (m_i / rho_i)^(1/dim) / h_i - 1| <= tolerance,
       rho_i   = sum_j m_j W_ij(h_i),
       Omega_i = 1 + h_i / (dim rho_i) sum_j m_j dW_ij/dh_i.
   On a lattice of spacing dx, h is eta dx, but for the error of the kernel there. The method never diverges,
   and with a good guess makes two or three passes over the list.
   list_radius  h_i is never made longer than list_radius_i / support ratio. A list_radius is at most half a
                periodic length.
   h            Before the call: a guess for each target (any positive number). After it: the result.
   The status of a target that is not SPH_OK:
   SPH_LIST_TOO_SHORT   h would have to be longer. h[i] is the one to try next (at most twice the longest that
                        was allowed); rho and omega are those at list_radius_i / support ratio. Build a list
                        that is longer where h[i] * support ratio exceeds list_radius_i, and call again. Or
                        stop at the longest h that makes sense, and keep rho and omega.
   SPH_TOO_FEW          No h is long enough, because all sources (in a periodic box: all within half of it)
                        have too little mass. A particle alone is such a case: its rho h^dim is a constant, so
                        that every h fits or none. h[i] is list_radius_i / support ratio; rho and omega are 0.
   SPH_SINGULAR         No h is short enough, because at any h the particle, with those that coincide with it,
                        has more mass than eta^dim allows: eta is too small, or particles have clumped in one
                        point. rho and omega are 0. h[i] is too short to reach any particle elsewhere; it is
                        the guess, if that was so short.
   SPH_NOT_AVAILABLE    m_i is not positive. rho and omega are 0; h[i] is as it was.
   SPH_ILL_CONDITIONED  rho jumps across the solution. This happens with kernels that are cut off at their
                        edge (the Gaussians). h[i] is the place of the jump; rho and omega are those there.
   SPH_NOT_FINITE       The sums overflowed. rho and omega are 0; h[i] is where that happened.
   Errors, besides those of all sweeps: SPH_ERROR_H for a guess or a list_radius that is not finite and
   positive, SPH_ERROR_VALUE for eta or tolerance out of range, SPH_ERROR_BOX for a list_radius beyond half
   the box. Ranges of targets may run in parallel, because a range reads only its own entries of h.
   Atlas: value exact for nothing; order 0 inside lattices, 0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_density_adaptive(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                      sph_density_options options, sph_density_out out)
{
    const size_t stride = sphi_stride(out.stride);
    const sph_scalars radius = options.list_radius;
    const sph_real eta = options.eta == SPH_R(0) ? sph_kernel_h_over_dx(k) : options.eta,
                   tolerance = options.tolerance == SPH_R(0) ? SPH_R(1e-3) : options.tolerance;
    const sph_real least = SPH_R(64) * SPH_EPSILON, accepted = tolerance > least ? tolerance : least;
    sph_real longest_radius = SPH_R(0);
    sph_index i, failed = 0;
    int error = sphi_check_frame(dim, cloud);
    if (error >= 0 && sphi_check_kernel(k)) return SPH_ERROR_KERNEL;
    if (!error && !radius.p) error = sphi_refuse("list_radius", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_h("list_radius", radius, cloud.last, &longest_radius);
    if (!error) error = sphi_check_field("m", m, cloud.points.n);
    if (!error) error = sphi_check_scan(dim, cloud, longest_radius);
    if (!error && (!out.h || !out.rho)) error = sphi_refuse("out.h, out.rho", -1, SPH_ERROR_NULL);
    if (!error && (!sphi_finite(eta) || !(eta > SPH_R(0)))) error = sphi_refuse("eta", -1, SPH_ERROR_VALUE);
    if (!error && (!sphi_finite(tolerance) || tolerance < SPH_R(0) || !(tolerance < SPH_R(1))))
        error = sphi_refuse("tolerance", -1, SPH_ERROR_VALUE);
    for (i = cloud.first; SPH_CHECK && !error && i < cloud.last; i++) {
        const sph_real guess = out.h[(size_t)i * stride];
        if (!sphi_finite(guess) || !(guess > SPH_R(0))) error = sphi_refuse("out.h", i, SPH_ERROR_H);
    }
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real longest = sphi_at(radius, i) / sph_kernel_support_ratio(k);
        SPH_GLOBAL sph_real *const h = out.h + (size_t)i * stride;
        sph_density_sums sums = sph_density_pair(k, dim, SPH_R(0), SPH_R(0));
        sph_real density = SPH_R(0), factor = SPH_R(0);
        int state = SPH_NOT_AVAILABLE;
        if (sphi_at(m, i) > SPH_R(0)) {
            /* If the radius is a denormal number, the longest h may be 0. */
            state = longest > SPH_R(0) ? sphi_density_solve(k, dim, i, cloud.points, cloud.list, longest, m,
                                                            eta, accepted, h, &sums)
                                       : (int)SPH_NOT_FINITE;
            if (state == SPH_OK || state == SPH_ILL_CONDITIONED || state == SPH_LIST_TOO_SHORT) {
                density = sph_density_value(k, dim, sums, *h);
                factor = sums.weight > SPH_R(0) ? sph_density_omega(dim, sums) : SPH_R(0);
                if (!sphi_finite(density) || !sphi_finite(factor)) state = SPH_NOT_FINITE;
            }
            if (state == SPH_LIST_TOO_SHORT)
                state = sphi_density_longer(k, dim, i, cloud.points, cloud.list, m, eta, sums, h);
        }
        if (state == SPH_TOO_FEW || state == SPH_NOT_FINITE) density = factor = SPH_R(0);
        sphi_put(out.rho, stride, i, density);
        sphi_put(out.omega, stride, i, factor);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* ================================================================ gradients and two-point Laplacians
 *
 * With x_ij = x_i - x_j, e = -x_ij, F = (1/r) dW/dr <= 0 and grad_i W_ij = F_ij x_ij:
 *     difference   grad f_i = sum_j V_j (f_j - f_i) grad_i W_ij
 *     CSPM         grad f_i = K^-1 sum_j V_j (-F_ij) e (f_j - f_i),   K = sum_j V_j (-F_ij) e e^T
 *     IAD          grad f_i = C sum_j V_j W_ij e (f_j - f_i),           C^-1 = sum_j V_j W_ij e e^T
 *     Brookshaw    lap f_i  = sum_j 2 V_j (f_i - f_j) F_ij
 * The unit of a gradient is that of f / length, that of a Laplacian f / length^2. K has no unit, C has
 * 1 / length^2.
 */

/* V_j (f_j - f_i) grad_i W_ij, where df = f_j - f_i: a pair's part of grad f_i. The sum is exact for
   constants. Its error is O(h^2) in the interior where the particles are regular, down to what h / dx leaves
   (0.1 % for wendland-c2 and h = 2 dx in 2D), and O(1) at a boundary and in disorder. Source: Monaghan 1992,
   ARA&A 30, 543, in difference form. */
SPH_FN sph_vec sph_gradient_pair_difference(sph_kernel k, int dim, sph_real V_j, sph_real df, sph_vec x_ij,
                                            sph_real r, sph_real h)
{
    return sph_scale(V_j * df * sph_kernel_f(k, dim, r, h), x_ij);
}

/* The weight of (f_j - f_i) in Brookshaw's Laplacian: -2 V_j F_ij >= 0, so that
       L f_i = sum_j weight (f_j - f_i) = sum_j 2 V_j (f_i - f_j) F_ij.
   It is exact for constants. The error is O(h^2) in the interior of a regular cloud, down to what h / dx
   leaves (0.1 % for wendland-c2 and h = 2 dx in 2D), and O(1/h) at a boundary and in disorder. Source:
   Brookshaw 1985, Proc. ASA 6, 207. */
SPH_FN sph_real sph_laplacian_weight_brookshaw(sph_kernel k, int dim, sph_real r, sph_real h, sph_real V_j)
{
    return SPH_R(-2) * V_j * sph_kernel_f(k, dim, r, h);
}

/* The weight -V_j F_ij >= 0 of CSPM's gradient: K = sum_j weight e e^T, grad f_i = K^-1 sum_j weight e df
   with e = x_j - x_i and df = f_j - f_i. Here e is not divided by h, because h cancels. */
SPH_FN sph_real sph_moment_weight_gradient(sph_kernel k, int dim, sph_real r, sph_real h, sph_real V_j)
{
    return -V_j * sph_kernel_f(k, dim, r, h);
}

/* The weight V_j W_ij of the integral approach to derivatives (IAD), in the place of -V_j F_ij of CSPM. It
   needs no derivative of the kernel. Garcia-Senz, Cabezon & Escartin 2012, A&A 538, A9. */
SPH_FN sph_real sph_moment_weight_iad(sph_kernel k, int dim, sph_real r, sph_real h, sph_real V_j)
{
    return V_j * sph_kernel_w(k, dim, r, h);
}

/* *inverse = K^-1 for the symmetric K = moment. Returns SPH_OK, or SPH_SINGULAR and then writes nothing. For
   the test of singularity K is scaled to a unit diagonal. *conditioning is the smallest pivot of the scaled
   K, in [0, 1] (1 good, 0 singular); the pointer may be null. */
SPH_FN int sph_solve_gradient(int dim, sph_sym moment, sph_sym *inverse, sph_real *conditioning)
{
    sph_real a, b, c, p, q, l, n, s, t;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    if (dim < 3) moment.zz = SPH_R(1), moment.xz = moment.yz = SPH_R(0);
    if (dim < 2) moment.yy = SPH_R(1), moment.xy = SPH_R(0);
    if (!(moment.xx > SPH_R(0)) || !(moment.yy > SPH_R(0)) || !(moment.zz > SPH_R(0))) return SPH_SINGULAR;
    a = SPH_R(1) / SPHI_SQRT(moment.xx);
    b = SPH_R(1) / SPHI_SQRT(moment.yy);
    c = SPH_R(1) / SPHI_SQRT(moment.zz);
    moment.xy *= a * b;
    moment.xz *= a * c;
    moment.yz *= b * c;
    /* K = L D L^T with D = (1, p, q). Cofactors over the determinant would lose twice as many digits where K
       is nearly singular. */
    p = SPH_R(1) - moment.xy * moment.xy;
    if (!(p > SPHI_PIVOT_MIN)) return SPH_SINGULAR;
    s = SPH_R(1) / p;
    t = moment.yz - moment.xy * moment.xz;
    l = t * s;
    q = SPH_R(1) - moment.xz * moment.xz - t * l;
    if (!(q > SPHI_PIVOT_MIN)) return SPH_SINGULAR;
    t = SPH_R(1) / q;
    n = moment.xy * l - moment.xz; /* L^-1 has the rows 1, 0, 0; -xy, 1, 0; n, -l, 1 */
    inverse->xx = (SPH_R(1) + moment.xy * moment.xy * s + n * n * t) * a * a;
    inverse->xy = -(moment.xy * s + n * l * t) * a * b;
    inverse->xz = n * t * a * c;
    inverse->yy = (s + l * l * t) * b * b;
    inverse->yz = -l * t * b * c;
    inverse->zz = t * c * c;
    if (conditioning) *conditioning = q < p ? q : p;
    return SPH_OK;
}

/* -------- gradients: sweeps */

/* grad f_i = sum_j V_j (f_j - f_i) grad_i W_ij, without correction. Exact for constants; for source and
   errors see sph_gradient_pair_difference. Where a component overflows, the gradient is 0 and the target
   counts as failed.
   Atlas: gradient exact for constants; order 0 inside lattices, 0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_gradient_difference(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                         sph_vector_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error) error = sphi_check_out("out", dim, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), f_i = sphi_at(f, i);
        sph_real sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sx, sy, sz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_vec g = sph_gradient_pair_difference(
                k, dim, sphi_at(cloud.volume, j), sphi_at(f, j) - f_i, x_ij, sph_length(dim, x_ij), h_i);
            sx += g.x;
            sy += g.y;
            sz += g.z;
        }
        sum.x = sx;
        sum.y = sy;
        sum.z = sz;
        failed += sphi_store_vector(dim, out, i, sum);
    }
    return failed;
}

/* The weights of the two corrected gradients. */
enum { SPHI_BY_CSPM, SPHI_BY_IAD };
SPH_FN sph_real sphi_moment_weight(int method, sph_kernel k, int dim, sph_real r, sph_real h, sph_real V_j)
{
    return method == SPHI_BY_IAD ? sph_moment_weight_iad(k, dim, r, h, V_j)
                                 : sph_moment_weight_gradient(k, dim, r, h, V_j);
}

/* *moment = K = sum_j weight e e^T with e = x_j - x_i. If with_f is 1: *sum = sum_j weight e (f_j - f_i); if
   it is 2: *sum = sum_j weight e. */
SPH_FN void sphi_gradient_moments(int method, sph_kernel k, int dim, sph_index i, sph_points x, sph_list list,
                                  sph_real h_i, sph_scalars volume, int with_f, sph_scalars f,
                                  sph_sym *moment, sph_vec *sum)
{
    const sph_vec x_i = sphi_point(dim, x, i);
    const sph_real f_i = with_f == 1 ? sphi_at(f, i) : SPH_R(0);
    sph_real xx = SPH_R(0), xy = SPH_R(0), yy = SPH_R(0), xz = SPH_R(0), yz = SPH_R(0), zz = SPH_R(0),
             sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
    sph_index p;
    SPH_SUM(p, list.start[i], list.start[i + 1], xx, xy, yy, xz, yz, zz, sx, sy, sz) {
        const sph_index j = list.index[p];
        const sph_vec e = sphi_separation(dim, x, sphi_point(dim, x, j), x_i);
        const sph_vec we =
            sph_scale(sphi_moment_weight(method, k, dim, sph_length(dim, e), h_i, sphi_at(volume, j)), e);
        const sph_real df = with_f == 1 ? sphi_at(f, j) - f_i : SPH_R(1);
        xx += we.x * e.x;
        if (dim > 1) {
            xy += we.x * e.y;
            yy += we.y * e.y;
        }
        if (dim > 2) {
            xz += we.x * e.z;
            yz += we.y * e.z;
            zz += we.z * e.z;
        }
        if (with_f) {
            sx += we.x * df;
            if (dim > 1) sy += we.y * df;
            if (dim > 2) sz += we.z * df;
        }
    }
    moment->xx = xx;
    moment->xy = xy;
    moment->yy = yy;
    moment->xz = xz;
    moment->yz = yz;
    moment->zz = zz;
    sum->x = sx;
    sum->y = sy;
    sum->z = sz;
}

SPH_FN sph_index sphi_gradient_corrected(int method, sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                         sph_derivatives_out out)
{
    const sph_vector_out gradient = sph_vector_out_strided(out.gx, out.gy, out.gz, sphi_stride(out.stride));
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error) error = sphi_check_out("out", dim, gradient);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_sym moment, inverse = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)};
        sph_vec sum;
        sph_real pivot = SPH_R(0);
        int state;
        sphi_gradient_moments(method, k, dim, i, cloud.points, cloud.list, h_i, cloud.volume, 1, f, &moment,
                              &sum);
        state = sph_solve_gradient(dim, moment, &inverse, &pivot);
        if (state) {
            state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i, dim);
            sum.x = sum.y = sum.z = SPH_R(0);
        } else sum = sphi_sym_times(dim, inverse, sum);
        if (sphi_store_vector(dim, gradient, i, sum)) state = SPH_NOT_FINITE;
        sphi_put(out.conditioning, gradient.stride, i, pivot);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}
SPH_FN sph_index sphi_gradient_rows(int method, sph_kernel k, int dim, sph_cloud cloud,
                                    sph_gradient_rows_out out)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT wx = out.x, *const SPH_RESTRICT wy = out.y,
                                            *const SPH_RESTRICT wz = out.z;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_out("out", dim, sph_vector_out_separate(wx, wy, wz));
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_sym moment, inverse = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)};
        sph_vec sum;
        sph_real pivot = SPH_R(0);
        int state;
        sphi_gradient_moments(method, k, dim, i, cloud.points, cloud.list, h_i, cloud.volume, 0, cloud.volume,
                              &moment, &sum);
        state = sph_solve_gradient(dim, moment, &inverse, &pivot);
        if (state) state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i, dim);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_vec e =
                sphi_separation(dim, cloud.points, sphi_point(dim, cloud.points, cloud.list.index[p]), x_i);
            sph_vec w = sph_scale(SPH_R(0), e);
            if (!state)
                w = sphi_sym_times(dim, inverse,
                                   sph_scale(sphi_moment_weight(method, k, dim, sph_length(dim, e), h_i,
                                                                sphi_at(cloud.volume, cloud.list.index[p])),
                                             e));
            wx[p] = w.x;
            if (dim > 1) wy[p] = w.y;
            if (dim > 2) wz[p] = w.z;
        }
        if (sphi_gradient_row_finite(dim, out, cloud.list, i, 0)) state = SPH_NOT_FINITE;
        sphi_put(out.conditioning, sphi_stride(out.stride), i, pivot);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}
/* The matrices K^-1 that correct a gradient, for those who apply them themselves. */
SPH_FN sph_index sphi_gradient_correction(int method, sph_kernel k, int dim, sph_cloud cloud,
                                          sph_correction_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_matrix_out("out.inverse", dim, out.inverse);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_sym moment, inverse = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)};
        sph_vec sum;
        sph_real pivot = SPH_R(0);
        int state;
        sphi_gradient_moments(method, k, dim, i, cloud.points, cloud.list, h_i, cloud.volume, 0, cloud.volume,
                              &moment, &sum);
        state = sph_solve_gradient(dim, moment, &inverse, &pivot);
        if (state) state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i, dim);
        if (sphi_store_matrix(dim, out.inverse, i, sph_mat_of_sym(dim, inverse))) state = SPH_NOT_FINITE;
        sphi_put(out.conditioning, sphi_stride(out.stride), i, pivot);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* grad f_i = K^-1 sum_j V_j (-F_ij) e (f_j - f_i) with K = sum_j V_j (-F_ij) e e^T and e = x_j - x_i. It is
   exact for linear fields at any particle; the error is O(h^2) in the interior of a regular cloud, and O(h)
   in disorder and at a boundary. Sources: Randles & Libersky 1996, CMAME 139, 375; in 1D CSPM, (3.5) of the
   ICSPM paper (with W', where its list under (5.17) prints W).
   Of out, gx (with gy and gz as dim needs them) is filled, and conditioning and status if they are not null.
   conditioning is the smallest pivot of K scaled to a unit diagonal, in [0, 1]. A target needs dim neighbours
   inside its support; in 2D not all may be on one line with it, in 3D not all in one plane with it. Else the
   gradient is 0, with SPH_TOO_FEW or SPH_SINGULAR. Where a component overflows, it is 0 with
   SPH_NOT_FINITE.
   Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries. */
SPH_FN sph_index sph_gradient_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                   sph_derivatives_out out)
{
    return sphi_gradient_corrected(SPHI_BY_CSPM, k, dim, cloud, f, out);
}
/* grad f_i = C sum_j V_j W_ij e (f_j - f_i) with C^-1 = sum_j V_j W_ij e e^T and e = x_j - x_i: the integral
   approach to derivatives (IAD). Exact for linear fields at any particle, and of the errors of
   sph_gradient_cspm; it needs no derivative of the kernel, and near neighbours count less. Garcia-Senz,
   Cabezon & Escartin 2012, A&A 538, A9. Outputs and statuses are those of sph_gradient_cspm.
   Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries. */
SPH_FN sph_index sph_gradient_iad(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                  sph_derivatives_out out)
{
    return sphi_gradient_corrected(SPHI_BY_IAD, k, dim, cloud, f, out);
}

/* The same gradient as rows: grad f_i = sum_p (x[p], y[p], z[p]) (f_j - f_i), where p runs along the list of
   i and j = index[p]. The rows of a target that is not SPH_OK are 0. */
SPH_FN sph_index sph_gradient_rows_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_gradient_rows_out out)
{
    return sphi_gradient_rows(SPHI_BY_CSPM, k, dim, cloud, out);
}
/* Those of sph_gradient_iad. */
SPH_FN sph_index sph_gradient_rows_iad(sph_kernel k, int dim, sph_cloud cloud, sph_gradient_rows_out out)
{
    return sphi_gradient_rows(SPHI_BY_IAD, k, dim, cloud, out);
}

/* K^-1 of sph_gradient_cspm, a symmetric matrix without unit: grad f_i = K^-1 sum_j V_j (f_j - f_i) grad_i
   W_ij. It is what solids need of their reference state. The matrix of a target that is SPH_TOO_FEW,
   SPH_SINGULAR or SPH_NOT_FINITE is 0. */
SPH_FN sph_index sph_gradient_correction_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_correction_out out)
{
    return sphi_gradient_correction(SPHI_BY_CSPM, k, dim, cloud, out);
}
/* C of sph_gradient_iad, a symmetric matrix of the unit 1 / length^2. It is what sph_gas_rates_iad needs. */
SPH_FN sph_index sph_gradient_correction_iad(sph_kernel k, int dim, sph_cloud cloud, sph_correction_out out)
{
    return sphi_gradient_correction(SPHI_BY_IAD, k, dim, cloud, out);
}

/* -------- two-point Laplacians: sweeps */

/* The sum of a target. */
SPH_FN sph_real sphi_brookshaw_sum(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f, sph_index i)
{
    const sph_vec x_i = sphi_point(dim, cloud.points, i);
    const sph_real h_i = sphi_at(cloud.h, i), f_i = sphi_at(f, i);
    sph_real sum = SPH_R(0);
    sph_index p;
    SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum) {
        const sph_index j = cloud.list.index[p];
        const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
        sum += sph_laplacian_weight_brookshaw(k, dim, sph_length(dim, x_ij), h_i, sphi_at(cloud.volume, j)) *
               (sphi_at(f, j) - f_i);
    }
    return sum;
}
/* L f_i = sum_j 2 V_j (f_i - f_j) F_ij. For source and errors see sph_laplacian_weight_brookshaw. Where the
   sum overflows, the result is 0 and SPH_NOT_FINITE.
   Atlas: Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_laplacian_brookshaw(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                         sph_scalar_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++)
        failed += sphi_store(out, i, sphi_brookshaw_sum(k, dim, cloud, f, i));
    return failed;
}
/* The same Laplacian as rows: L f_i = sum_p row[p] (f_j - f_i) with row[p] = -2 V_j F_ij >= 0, factor 1 and
   conditioning 1. A row that overflows is 0, with SPH_NOT_FINITE. */
SPH_FN sph_index sph_laplacian_rows_brookshaw(sph_kernel k, int dim, sph_cloud cloud, sph_rows_out out)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT row = out.row;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error && !row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        int lost;
        SPH_EACH(p, cloud.list.start[i], cloud.list.start[i + 1]) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            row[p] =
                sph_laplacian_weight_brookshaw(k, dim, sph_length(dim, x_ij), h_i, sphi_at(cloud.volume, j));
        }
        lost = sphi_row_finite(row, cloud.list.start[i], cloud.list.start[i + 1]);
        sphi_row_answer(out, cloud.list, i, 1, SPH_R(1), lost ? (int)SPH_NOT_FINITE : (int)SPH_OK);
        failed += lost;
    }
    return failed;
}

/* ================================================================ second derivatives
 *
 * One system serves CSPM, ICSPM, Fatehi & Manzari and weighted least squares (WLS). With e = (x_j - x_i) / h
 * = -x_ij / h and df = f_j - f_i, Taylor's series
 *     df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...
 * is summed against dim test functions g e_a, and dim (dim + 1) / 2 test functions w e_a e_b with a <= b:
 *     [ K  B ] [ h grad f ]   [ sum g e df   ]        K = sum g e e,  B = sum g e ee,
 *     [ A  M ] [ h^2 hess ] = [ sum w e e df ]        A = sum w ee e, M = sum w ee ee.
 * Here hess holds the coefficients of e_a e_b: d_a d_b f for a < b, and half of it for a = b.
 *   CSPM    g = -V_j F_ij and w = V_j W_ij / r^2. The gradient is solved as if B were 0, then the Hessian:
 *               h grad f = K^-1 sum g e df,   h^2 hess = M^-1 (sum w e e df - A h grad f).
 *           In 1D these are (3.5) and (5.15) of the ICSPM paper.
 *   ICSPM   The same test functions, but both rows are solved together. In 1D this is (5.17) of the ICSPM
 *           paper: hess = hess_CSPM / kappa with kappa = 1 - A B / (K M).
 *   Fatehi-Manzari   g = -V_j F_ij and w = -V_j F_ij / r^2, solved as ICSPM. Their Laplacian is the trace of
 *           this Hessian: e (x) grad W (f_i - f_j) / r, which they sum, is F x_ij x_ij / r^2 (f_i - f_j).
 *   WLS     g = w = V_j W_ij. The system is that of a weighted least-squares fit of a quadratic (moving least
 *           squares at the particle).
 *
 * Sources. CSPM: Chen, Beraun & Carney 1999, IJNME 46, 231. Fatehi & Manzari 2011, Comput. Math. Appl. 61,
 * 482; that their scheme is this system is shown in tests/test_laplacians.c. "ICSPM paper": Korzilius,
 * Schilders & Anthonissen 2017, J. Appl. Math. Phys. 5, 168, in 1D. In more dimensions ICSPM is its natural
 * extension with the matrix kappa = 1 - M^-1 A K^-1 B, which is exactly the kappa of the paper in 1D.
 * Misprints of the ICSPM paper that are corrected here: (4.14) and (5.17) print kappa with a plus sign; the
 * list under (5.17) prints W instead of W' in <f'>; section II prints dW/dy, which is -dW/dx.
 * tests/test_derivatives.c shows that the printed forms fail.
 *
 * Exact for   CSPM gradient: linear fields. CSPM Hessian: quadratic fields, in the interior of symmetric
 *             clouds only. The others: quadratic fields, for any positions and volumes.
 * Errors      In the interior of a regular cloud: all O(h^2). At a boundary: CSPM gradient O(h) and Hessian
 *             O(1), the others gradient O(h^2) and Hessian O(h). In disorder the Hessian of CSPM has O(1),
 *             that of the others O(h).
 * Signs       The weights w = V_j W_ij / r^2 make most rows of CSPM and ICSPM non-monotone in disorder; those
 *             of Fatehi-Manzari and WLS are monotone in the interior (tests/test_laplacians.c has figures).
 * kappa       det(kappa) is 1 in the interior and negative for one-sided neighbours, so that it is 0
 *             somewhere in between: in 1D, with wendland-c4-1d, at 0.30 h from the end of the domain. There
 *             ICSPM amplifies rounding and truncation errors, and so does Fatehi-Manzari at its own such
 *             places. Their conditioning shows this; WLS, whose matrix is definite, is the fallback.
 */

/* The weights g and w of the test functions. */
typedef struct sph_test_weights {
    sph_real g, w;
} sph_test_weights;

/* The weights of CSPM and ICSPM, g = -V_j F_ij and w = V_j W_ij / r^2, at q = r / h. Powers of h and the
   normalisation of the kernel cancel and are left out. At q = 0, w is 0. Needs q >= 0. */
SPH_FN sph_test_weights sph_test_weights_cspm(sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    sph_test_weights t;
    t.g = -V_j * sph_kernel_shape_f(k, dim, q);
    t.w = V_j * sphi_over_q(sph_kernel_shape(k, dim, q), q * q);
    return t;
}
/* The weights of Fatehi & Manzari, g = -V_j F_ij and w = -V_j F_ij / r^2, likewise. At q = 0, w is 0. Needs
   q >= 0. */
SPH_FN sph_test_weights sph_test_weights_fatehi_manzari(sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    sph_test_weights t;
    t.g = -V_j * sph_kernel_shape_f(k, dim, q);
    t.w = sphi_over_q(t.g, q * q);
    return t;
}
/* The weights of WLS, g = w = V_j W_ij, likewise. Needs q >= 0. */
SPH_FN sph_test_weights sph_test_weights_wls(sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    sph_test_weights t;
    t.g = t.w = V_j * sph_kernel_shape(k, dim, q);
    return t;
}
/* The weights of Liu & Liu for a linear fit (see linear fits), g = -V_j F_ij and w = V_j W_ij, likewise.
   Needs q >= 0. */
SPH_FN sph_test_weights sph_test_weights_liu(sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    sph_test_weights t;
    t.g = -V_j * sph_kernel_shape_f(k, dim, q);
    t.w = V_j * sph_kernel_shape(k, dim, q);
    return t;
}

/* The sums: the dimension from which on they are needed, their names, and what a neighbour at e = (x, y, z)
   adds. The nine sums at most of a list stay in registers, and no two lists share a product. */
/* clang-format off */
#define SPHI_SUMS_GX(X) \
    X(1, gxx, g * x * x) X(1, gxxx, g * x * x * x) \
    X(2, gxy, g * x * y) X(2, gxxy, g * x * x * y) X(2, gxyy, g * x * y * y) \
    X(3, gxz, g * x * z) X(3, gxxz, g * x * x * z) X(3, gxyz, g * x * y * z) X(3, gxzz, g * x * z * z)
#define SPHI_SUMS_GYZ(X) \
    X(2, gyy, g * y * y) X(2, gyyy, g * y * y * y) \
    X(3, gyz, g * y * z) X(3, gzz, g * z * z) \
    X(3, gyyz, g * y * y * z) X(3, gyzz, g * y * z * z) X(3, gzzz, g * z * z * z)
#define SPHI_SUMS_WXX(X) \
    X(1, wxxx, w * x * x * x) X(1, wxxxx, w * x * x * x * x) \
    X(2, wxxy, w * x * x * y) X(2, wxxxy, w * x * x * x * y) X(2, wxxyy, w * x * x * y * y) \
    X(3, wxxz, w * x * x * z) X(3, wxxxz, w * x * x * x * z) X(3, wxxyz, w * x * x * y * z) \
    X(3, wxxzz, w * x * x * z * z)
#define SPHI_SUMS_WXYZ(X) \
    X(2, wxyy, w * x * y * y) X(2, wxyyy, w * x * y * y * y) \
    X(3, wxyz, w * x * y * z) X(3, wxzz, w * x * z * z) X(3, wxyyz, w * x * y * y * z) \
    X(3, wxyzz, w * x * y * z * z) X(3, wxzzz, w * x * z * z * z)
#define SPHI_SUMS_WYZ(X) \
    X(2, wyyy, w * y * y * y) X(2, wyyyy, w * y * y * y * y) \
    X(3, wyyz, w * y * y * z) X(3, wyzz, w * y * z * z) X(3, wzzz, w * z * z * z) \
    X(3, wyyyz, w * y * y * y * z) X(3, wyyzz, w * y * y * z * z) X(3, wyzzz, w * y * z * z * z) \
    X(3, wzzzz, w * z * z * z * z)
#define SPHI_SUMS_VALUE(X) \
    X(1, gfx, g * df * x) X(1, wfxx, w * df * x * x) \
    X(2, gfy, g * df * y) X(2, wfxy, w * df * x * y) X(2, wfyy, w * df * y * y) \
    X(3, gfz, g * df * z) X(3, wfxz, w * df * x * z) X(3, wfyz, w * df * y * z) X(3, wfzz, w * df * z * z)
#define SPHI_SUMS_MATRIX(X) \
    SPHI_SUMS_GX(X) SPHI_SUMS_GYZ(X) SPHI_SUMS_WXX(X) SPHI_SUMS_WXYZ(X) SPHI_SUMS_WYZ(X)
/* clang-format on */

/* The sums of one particle: gxy is sum g e_x e_y, and so on. gfx, wfxx, ... are the right-hand side. */
#define SPHI_FIELD(from, name, formula) sph_real name;
typedef struct sph_moments {
    SPHI_SUMS_MATRIX(SPHI_FIELD)
    SPHI_SUMS_VALUE(SPHI_FIELD)
} sph_moments;

#define SPHI_ZERO(from, name, formula) s.name = SPH_R(0);
/* All sums are 0. */
SPH_FN sph_moments sph_moments_zero(void)
{
    sph_moments s;
    SPHI_SUMS_MATRIX(SPHI_ZERO)
    SPHI_SUMS_VALUE(SPHI_ZERO)
    return s;
}

#define SPHI_ADD(from, name, formula) \
    if (dim >= from) s->name += formula;
/* Adds what a neighbour contributes to the matrix: g e e, g e ee, w ee e and w ee ee. e is (x_j - x_i) / h_i;
   t comes from sph_test_weights_cspm (for CSPM and ICSPM), sph_test_weights_fatehi_manzari or
   sph_test_weights_wls. */
SPH_FN void sph_moments_add(int dim, sph_moments *s, sph_vec e, sph_test_weights t)
{
    const sph_real x = e.x, y = e.y, z = e.z, g = t.g, w = t.w;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    SPHI_SUMS_MATRIX(SPHI_ADD)
}
/* Adds what a neighbour contributes to the right-hand side: g e df and w ee df with df = f_j - f_i. */
SPH_FN void sph_moments_add_value(int dim, sph_moments *s, sph_vec e, sph_test_weights t, sph_real df)
{
    const sph_real x = e.x, y = e.y, z = e.z, g = t.g, w = t.w;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    SPHI_SUMS_VALUE(SPHI_ADD)
}

/* First and second derivatives. As a result, these are the derivatives of f. As an operator, they are the
   coefficients of
       D f = sum_a gradient_a d_a f + sum_{a <= b} hessian_ab d_a d_b f,
   where each mixed derivative counts once. The Laplacian has hessian.xx = hessian.yy = hessian.zz = 1, and
   all else is 0. */
typedef struct sph_jet {
    sph_vec gradient;
    sph_sym hessian;
} sph_jet;

/* The operator D = sum_a d_a d_a, the Laplacian. */
SPH_FN sph_jet sph_jet_laplacian(int dim)
{
    sph_jet d;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    d.gradient.x = d.gradient.y = d.gradient.z = d.hessian.xy = d.hessian.xz = d.hessian.yz = SPH_R(0);
    d.hessian.xx = SPH_R(1);
    d.hessian.yy = dim > 1 ? SPH_R(1) : SPH_R(0);
    d.hessian.zz = dim > 2 ? SPH_R(1) : SPH_R(0);
    return d;
}

/* -------- the block system */

/* The unknowns have the order (x, y, z) and (xx, xy, yy, xz, yz, zz), so that lower dimensions are the
   leading parts. The second ones are the coefficients of e_a e_b (half the derivative for a = b). Rows and
   columns are scaled to unit diagonals of K and M; the conditioning then does not depend on units. */

/* The number of unknowns of the Hessian: dim (dim + 1) / 2. */
SPH_FN int sphi_unknowns(int dim)
{
    SPH_ASSERT(SPHI_IS_DIM(dim));
    return dim > 2 ? 6 : dim > 1 ? 3 : 1;
}
/* dim itself, which is 1, 2 or 3, in a form from which compilers and analysers that do not know dim see it:
   a loop over the axes fills all that the branches for dim > 1 and dim > 2 read. */
SPH_FN int sphi_dimensions(int dim) { return dim > 2 ? 3 : dim > 1 ? 2 : 1; }

typedef struct sphi_blocks {
    sph_real kk[SPHI_MAX][SPHI_MAX], bb[SPHI_MAX][SPHI_MAX], aa[SPHI_MAX][SPHI_MAX], mm[SPHI_MAX][SPHI_MAX];
    sph_real s[SPHI_MAX], d[SPHI_MAX]; /* the scales of the unknowns of gradient and Hessian */
} sphi_blocks;

#define SPHI_SET(m, i, j, value) b->m[i][j] = b->m[j][i] = (value);
/* Fills and scales the blocks. Returns 1, or 0 if a diagonal entry is not positive: there is no neighbour in
   that direction, or volumes are negative. That unknown is then not scaled. */
SPH_FN int sphi_blocks_fill(int dim, const sph_moments *m, sphi_blocks *b)
{
    const int nd = sphi_dimensions(dim), nh = sphi_unknowns(dim);
    int i, j, positive = 1;
    b->kk[0][0] = m->gxx;
    b->bb[0][0] = m->gxxx;
    b->aa[0][0] = m->wxxx;
    b->mm[0][0] = m->wxxxx;
    if (dim > 1) {
        SPHI_SET(kk, 0, 1, m->gxy)
        b->kk[1][1] = m->gyy;
        b->bb[0][1] = b->bb[1][0] = m->gxxy;
        b->bb[0][2] = b->bb[1][1] = m->gxyy;
        b->bb[1][2] = m->gyyy;
        b->aa[1][0] = b->aa[0][1] = m->wxxy;
        b->aa[2][0] = b->aa[1][1] = m->wxyy;
        b->aa[2][1] = m->wyyy;
        SPHI_SET(mm, 0, 1, m->wxxxy)
        SPHI_SET(mm, 0, 2, m->wxxyy)
        b->mm[1][1] = m->wxxyy;
        SPHI_SET(mm, 1, 2, m->wxyyy)
        b->mm[2][2] = m->wyyyy;
    }
    if (dim > 2) {
        SPHI_SET(kk, 0, 2, m->gxz)
        SPHI_SET(kk, 1, 2, m->gyz)
        b->kk[2][2] = m->gzz;
        b->bb[0][3] = b->bb[2][0] = m->gxxz;
        b->bb[0][4] = b->bb[1][3] = b->bb[2][1] = m->gxyz;
        b->bb[0][5] = b->bb[2][3] = m->gxzz;
        b->bb[1][4] = b->bb[2][2] = m->gyyz;
        b->bb[1][5] = b->bb[2][4] = m->gyzz;
        b->bb[2][5] = m->gzzz;
        b->aa[3][0] = b->aa[0][2] = m->wxxz;
        b->aa[4][0] = b->aa[3][1] = b->aa[1][2] = m->wxyz;
        b->aa[5][0] = b->aa[3][2] = m->wxzz;
        b->aa[4][1] = b->aa[2][2] = m->wyyz;
        b->aa[5][1] = b->aa[4][2] = m->wyzz;
        b->aa[5][2] = m->wzzz;
        SPHI_SET(mm, 0, 3, m->wxxxz)
        SPHI_SET(mm, 0, 4, m->wxxyz)
        SPHI_SET(mm, 0, 5, m->wxxzz)
        SPHI_SET(mm, 1, 3, m->wxxyz)
        SPHI_SET(mm, 1, 4, m->wxyyz)
        SPHI_SET(mm, 1, 5, m->wxyzz)
        SPHI_SET(mm, 2, 3, m->wxyyz)
        SPHI_SET(mm, 2, 4, m->wyyyz)
        SPHI_SET(mm, 2, 5, m->wyyzz)
        b->mm[3][3] = m->wxxzz;
        SPHI_SET(mm, 3, 4, m->wxyzz)
        SPHI_SET(mm, 3, 5, m->wxzzz)
        b->mm[4][4] = m->wyyzz;
        SPHI_SET(mm, 4, 5, m->wyzzz)
        b->mm[5][5] = m->wzzzz;
    }
    for (i = 0; i < nd; i++) {
        const int ok = b->kk[i][i] > SPH_R(0);
        b->s[i] = ok ? SPH_R(1) / SPHI_SQRT(b->kk[i][i]) : SPH_R(1);
        positive = positive && ok;
    }
    for (i = 0; i < nh; i++) {
        const int ok = b->mm[i][i] > SPH_R(0);
        b->d[i] = ok ? SPH_R(1) / SPHI_SQRT(b->mm[i][i]) : SPH_R(1);
        positive = positive && ok;
    }
    for (i = 0; i < nd; i++) {
        for (j = 0; j < nd; j++) b->kk[i][j] *= b->s[i] * b->s[j];
        for (j = 0; j < nh; j++) {
            b->bb[i][j] *= b->s[i] * b->d[j];
            b->aa[j][i] *= b->s[i] * b->d[j];
        }
    }
    for (i = 0; i < nh; i++)
        for (j = 0; j < nh; j++) b->mm[i][j] *= b->d[i] * b->d[j];
    return positive;
}
#undef SPHI_SET

/* The right-hand side, scaled like the rows. */
SPH_FN void sphi_blocks_values(int dim, const sph_moments *m, const sphi_blocks *b, sph_real *u, sph_real *v)
{
    int i;
    for (i = 0; i < SPHI_MAX; i++) u[i] = v[i] = SPH_R(0); /* where dim is not a constant */
    u[0] = m->gfx * b->s[0];
    v[0] = m->wfxx * b->d[0];
    if (dim > 1) {
        u[1] = m->gfy * b->s[1];
        v[1] = m->wfxy * b->d[1];
        v[2] = m->wfyy * b->d[2];
    }
    if (dim > 2) {
        u[2] = m->gfz * b->s[2];
        v[3] = m->wfxz * b->d[3];
        v[4] = m->wfyz * b->d[4];
        v[5] = m->wfzz * b->d[5];
    }
}

/* The first function turns scaled unknowns into derivatives. The second turns the coefficients that an
   operator has for derivatives into those for scaled unknowns. */
SPH_FN sph_jet sphi_jet_unscaled(int dim, const sphi_blocks *b, sph_real h, const sph_real *u,
                                 const sph_real *v)
{
    const sph_real a = SPH_R(1) / h, c = a * a;
    sph_jet j = sph_jet_laplacian(dim);
    j.gradient.x = u[0] * b->s[0] * a;
    j.hessian.xx = SPH_R(2) * v[0] * b->d[0] * c;
    if (dim > 1) {
        j.gradient.y = u[1] * b->s[1] * a;
        j.hessian.xy = v[1] * b->d[1] * c;
        j.hessian.yy = SPH_R(2) * v[2] * b->d[2] * c;
    }
    if (dim > 2) {
        j.gradient.z = u[2] * b->s[2] * a;
        j.hessian.xz = v[3] * b->d[3] * c;
        j.hessian.yz = v[4] * b->d[4] * c;
        j.hessian.zz = SPH_R(2) * v[5] * b->d[5] * c;
    }
    return j;
}
SPH_FN void sphi_operator_scaled(int dim, const sphi_blocks *b, sph_real h, sph_jet op, sph_real *u,
                                 sph_real *v)
{
    const sph_real a = SPH_R(1) / h, c = a * a;
    int i;
    for (i = 0; i < SPHI_MAX; i++) u[i] = v[i] = SPH_R(0); /* where dim is not a constant */
    u[0] = op.gradient.x * b->s[0] * a;
    v[0] = SPH_R(2) * op.hessian.xx * b->d[0] * c;
    if (dim > 1) {
        u[1] = op.gradient.y * b->s[1] * a;
        v[1] = op.hessian.xy * b->d[1] * c;
        v[2] = SPH_R(2) * op.hessian.yy * b->d[2] * c;
    }
    if (dim > 2) {
        u[2] = op.gradient.z * b->s[2] * a;
        v[3] = op.hessian.xz * b->d[3] * c;
        v[4] = op.hessian.yz * b->d[4] * c;
        v[5] = SPH_R(2) * op.hessian.zz * b->d[5] * c;
    }
}

/* Copies m and factors it. */
SPH_FN void sphi_lu_load(int n, sphi_lu *s, sph_real (*m)[SPHI_MAX])
{
    int i, j;
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) s->a[i][j] = m[i][j];
    sphi_lu_factor(n, s);
}

/* Fills the blocks, and factors K and M. Returns SPH_OK, or SPH_SINGULAR if the neighbours do not determine a
   gradient or a Hessian at all. */
SPH_FN int sphi_blocks_factor(int dim, const sph_moments *m, sphi_blocks *b, sphi_lu *kk, sphi_lu *mm)
{
    const int positive = sphi_blocks_fill(dim, m, b);
    sphi_lu_load(sphi_dimensions(dim), kk, b->kk);
    sphi_lu_load(sphi_unknowns(dim), mm, b->mm);
    return !positive || kk->pivot_min < SPHI_PIVOT_MIN || mm->pivot_min < SPHI_PIVOT_MIN ? SPH_SINGULAR
                                                                                         : SPH_OK;
}

/* The Schur complement S = M - A K^-1 B = M kappa, or its transpose, factored. */
SPH_FN void sphi_schur(int dim, const sphi_blocks *b, const sphi_lu *kk, int transposed, sphi_lu *schur)
{
    const int nd = sphi_dimensions(dim), nh = sphi_unknowns(dim);
    sph_real x[SPHI_MAX * SPHI_MAX];
    int i, j, c;
    for (c = 0; c < nd; c++)
        for (j = 0; j < nh; j++) x[c * nh + j] = b->bb[c][j];
    sphi_lu_solve_columns(nd, kk, nh, x);
    for (i = 0; i < nh; i++) {
        sph_real y[SPHI_MAX];
        for (j = 0; j < nh; j++) y[j] = b->mm[i][j];
        for (c = 0; c < nd; c++)
            for (j = 0; j < nh; j++) y[j] -= b->aa[i][c] * x[c * nh + j];
        for (j = 0; j < nh; j++) schur->a[transposed ? j : i][transposed ? i : j] = y[j];
    }
    sphi_lu_factor(nh, schur);
}

/* sign(det kappa) / |kappa^-1| with kappa^-1 = S^-1 M, in the norm of the largest row sum. It is 1 in the
   interior, and kappa itself in 1D. */
SPH_FN sph_real sphi_conditioning(int dim, const sphi_blocks *b, const sphi_lu *schur)
{
    const int nh = sphi_unknowns(dim);
    sph_real x[SPHI_MAX * SPHI_MAX], largest = SPH_R(0);
    int i, j;
    for (i = 0; i < nh; i++)
        for (j = 0; j < nh; j++) x[i * nh + j] = b->mm[i][j];
    sphi_lu_solve_columns(nh, schur, nh, x);
    for (i = 0; i < nh; i++) {
        sph_real sum = SPH_R(0);
        for (j = 0; j < nh; j++) sum += SPHI_ABS(x[i * nh + j]);
        if (!(sum <= largest)) largest = sum;
    }
    return schur->sign / largest;
}

/* Gradient and Hessian by CSPM from the moments: h grad f = K^-1 sum g e df, and then
   h^2 hess = M^-1 (sum w e e df - A h grad f). Returns SPH_OK, or SPH_SINGULAR and then writes nothing.
   *conditioning is the smallest pivot of the scaled K and M, in [0, 1]: 1 for isotropic K, 0 where the
   neighbours do not determine the answer. It depends a little on the order of the axes. The pointer may be
   null. */
SPH_FN int sph_solve_cspm(int dim, const sph_moments *m, sph_real h, sph_jet *jet, sph_real *conditioning)
{
    const int nd = sphi_dimensions(dim), nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm;
    sph_real u[SPHI_MAX], v[SPHI_MAX], t[SPHI_MAX];
    int i;
    SPH_ASSERT(h > SPH_R(0));
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    sphi_blocks_values(dim, m, &b, u, v);
    sphi_lu_solve(nd, &kk, u);
    sphi_multiply(nh, nd, b.aa, u, t);
    for (i = 0; i < nh; i++) v[i] -= t[i];
    sphi_lu_solve(nh, &mm, v);
    *jet = sphi_jet_unscaled(dim, &b, h, u, v);
    if (conditioning) *conditioning = kk.pivot_min < mm.pivot_min ? kk.pivot_min : mm.pivot_min;
    return SPH_OK;
}

/* Gradient and Hessian by ICSPM, Fatehi-Manzari or WLS: the solution of the whole system, whose moments
   decide which of them it is. Returns SPH_OK, or SPH_SINGULAR and then writes nothing. *conditioning is kappa
   in 1D, and sign(det kappa) / |kappa^-1| in general: ICSPM multiplies the errors of CSPM by 1 /
   |conditioning|. The pointer may be null. */
SPH_FN int sph_solve_block(int dim, const sph_moments *m, sph_real h, sph_jet *jet, sph_real *conditioning)
{
    const int nd = sphi_dimensions(dim), nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm, schur;
    sph_real u[SPHI_MAX], v[SPHI_MAX], x[SPHI_MAX], t[SPHI_MAX];
    int i;
    SPH_ASSERT(h > SPH_R(0));
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    sphi_schur(dim, &b, &kk, 0, &schur);
    if (schur.pivot_min < SPHI_PIVOT_MIN) return SPH_SINGULAR;
    sphi_blocks_values(dim, m, &b, u, v);
    for (i = 0; i < nd; i++) x[i] = u[i];
    sphi_lu_solve(nd, &kk, x);
    sphi_multiply(nh, nd, b.aa, x, t);
    for (i = 0; i < nh; i++) v[i] -= t[i];
    sphi_lu_solve(nh, &schur, v);
    sphi_multiply(nd, nh, b.bb, v, t);
    for (i = 0; i < nd; i++) u[i] -= t[i];
    sphi_lu_solve(nd, &kk, u);
    *jet = sphi_jet_unscaled(dim, &b, h, u, v);
    if (conditioning) *conditioning = sphi_conditioning(dim, &b, &schur);
    return SPH_OK;
}

/* -------- rows */

/* The coefficients c of the row of an operator D. They depend on i only:
       sum_j weight_j (f_j - f_i) = factor D f_i,
       weight_j = g c.first . e + w sum_{a <= b} c.second_ab e_a e_b.
   The factor is 1, or kappa for ICSPM. */
typedef struct sph_coefficients {
    sph_vec first;
    sph_sym second;
    sph_real factor;
} sph_coefficients;

/* weight_j of the neighbour at e = (x_j - x_i) / h_i, whose test weights are t. */
SPH_FN sph_real sph_coefficients_weight(int dim, sph_coefficients c, sph_vec e, sph_test_weights t)
{
    sph_real second = c.second.xx * e.x * e.x;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    if (dim > 1) second += (c.second.xy * e.x + c.second.yy * e.y) * e.y;
    if (dim > 2) second += (c.second.xz * e.x + c.second.yz * e.y + c.second.zz * e.z) * e.z;
    return t.g * sph_dot(dim, c.first, e) + t.w * second;
}

/* The coefficients from scaled ones. */
SPH_FN sph_coefficients sphi_row_unscaled(int dim, const sphi_blocks *b, const sph_real *u, const sph_real *v,
                                          sph_real factor)
{
    sph_coefficients c;
    c.first.x = u[0] * b->s[0];
    c.second.xx = v[0] * b->d[0];
    c.first.y = c.first.z = c.second.xy = c.second.yy = c.second.xz = c.second.yz = c.second.zz = SPH_R(0);
    if (dim > 1) {
        c.first.y = u[1] * b->s[1];
        c.second.xy = v[1] * b->d[1];
        c.second.yy = v[2] * b->d[2];
    }
    if (dim > 2) {
        c.first.z = u[2] * b->s[2];
        c.second.xz = v[3] * b->d[3];
        c.second.yz = v[4] * b->d[4];
        c.second.zz = v[5] * b->d[5];
    }
    c.factor = factor;
    return c;
}

/* The row of the operator op by CSPM. Returns SPH_OK, or SPH_SINGULAR and then writes nothing. *conditioning
   is that of sph_solve_cspm. */
SPH_FN int sph_coefficients_cspm(int dim, const sph_moments *m, sph_real h, sph_jet op, sph_coefficients *c,
                                 sph_real *conditioning)
{
    const int nd = sphi_dimensions(dim), nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm;
    sph_real u[SPHI_MAX], v[SPHI_MAX], t[SPHI_MAX];
    int i;
    SPH_ASSERT(h > SPH_R(0));
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    sphi_operator_scaled(dim, &b, h, op, u, v);
    sphi_lu_solve(nh, &mm, v); /* K and M are symmetric */
    sphi_multiply_transposed(nh, nd, b.aa, v, t);
    for (i = 0; i < nd; i++) u[i] -= t[i];
    sphi_lu_solve(nd, &kk, u);
    *c = sphi_row_unscaled(dim, &b, u, v, SPH_R(1));
    if (conditioning) *conditioning = kk.pivot_min < mm.pivot_min ? kk.pivot_min : mm.pivot_min;
    return SPH_OK;
}

/* The row of the operator op by ICSPM or Fatehi-Manzari (icspm = 1), or by WLS (icspm = 0). Returns SPH_OK,
   or SPH_SINGULAR and then writes nothing. *conditioning is that of sph_solve_block. An ICSPM row is never
   divided by kappa. It is scaled to the size of the CSPM row, and the factor goes to the right-hand side. In
   1D the row is the CSPM row and the factor is kappa, as published. In general the factor is such that |M^T
   second| is the same as in CSPM. So row and factor stay finite where kappa is singular: the factor is 0
   there, and the row gives 0 for all quadratic fields, as it must. */
SPH_FN int sph_coefficients_block(int dim, int icspm, const sph_moments *m, sph_real h, sph_jet op,
                                  sph_coefficients *c, sph_real *conditioning)
{
    const int nd = sphi_dimensions(dim), nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm, schur;
    sph_real u[SPHI_MAX], v[SPHI_MAX], y[SPHI_MAX], t[SPHI_MAX], factor = SPH_R(1);
    int i;
    SPH_ASSERT(h > SPH_R(0));
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    if (conditioning || !icspm) {
        sphi_schur(dim, &b, &kk, 0, &schur);
        if (!icspm && schur.pivot_min < SPHI_PIVOT_MIN) return SPH_SINGULAR;
        if (conditioning) *conditioning = sphi_conditioning(dim, &b, &schur);
    }
    sphi_operator_scaled(dim, &b, h, op, u, y);
    for (i = 0; i < nd; i++) t[i] = u[i];
    sphi_lu_solve(nd, &kk, t);
    sphi_multiply_transposed(nd, nh, b.bb, t, v);
    for (i = 0; i < nh; i++) y[i] = v[i] = y[i] - v[i];
    sphi_schur(dim, &b, &kk, 1, &schur);
    sphi_lu_solve(nh, &schur, v);
    if (icspm) { /* M^T v is y in CSPM, and t = M v here (M is symmetric) */
        sph_real yy = SPH_R(0), tt = SPH_R(0), yt = SPH_R(0);
        sphi_multiply(nh, nh, b.mm, v, t);
        for (i = 0; i < nh; i++) {
            yy += y[i] * y[i];
            tt += t[i] * t[i];
            yt += y[i] * t[i];
        }
        if (yy > SPH_R(0) && tt > SPH_R(0)) factor = yt < SPH_R(0) ? -SPHI_SQRT(yy / tt) : SPHI_SQRT(yy / tt);
        for (i = 0; i < nh; i++) v[i] *= factor;
        for (i = 0; i < nd; i++) u[i] *= factor;
    }
    sphi_multiply_transposed(nh, nd, b.aa, v, t);
    for (i = 0; i < nd; i++) u[i] -= t[i];
    sphi_lu_solve(nd, &kk, u);
    *c = sphi_row_unscaled(dim, &b, u, v, factor);
    return SPH_OK;
}

SPH_FN sph_real sphi_trace(int dim, sph_sym s)
{
    return s.xx + (dim > 1 ? s.yy : SPH_R(0)) + (dim > 2 ? s.zz : SPH_R(0));
}
SPH_FN int sphi_jet_finite(int dim, sph_jet j)
{
    int ok = sphi_finite(j.gradient.x) && sphi_finite(j.hessian.xx);
    if (dim > 1)
        ok = ok && sphi_finite(j.gradient.y) && sphi_finite(j.hessian.xy) && sphi_finite(j.hessian.yy);
    if (dim > 2)
        ok = ok && sphi_finite(j.gradient.z) && sphi_finite(j.hessian.xz) && sphi_finite(j.hessian.yz) &&
             sphi_finite(j.hessian.zz);
    return ok;
}
/* -------- second derivatives: sweeps */

enum { SPHI_CSPM, SPHI_ICSPM, SPHI_FATEHI_MANZARI, SPHI_WLS, SPHI_LIU };
SPH_FN sph_test_weights sphi_test_weights(int method, sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    if (method == SPHI_FATEHI_MANZARI) return sph_test_weights_fatehi_manzari(k, dim, q, V_j);
    if (method == SPHI_LIU) return sph_test_weights_liu(k, dim, q, V_j);
    return method == SPHI_WLS ? sph_test_weights_wls(k, dim, q, V_j) : sph_test_weights_cspm(k, dim, q, V_j);
}

/* Several neighbours at a time, where the processor has vectors and the compiler has types for them. */
/* clang-format off */
#if (defined(__GNUC__) || defined(__clang__)) && !SPH_OPENCL && !defined(__CUDACC__) && \
    (defined(__SSE2__) || defined(__aarch64__) || defined(__VSX__))
#  if defined(__AVX__)
#    define SPHI_VECTOR_SIZE 32
#  else
#    define SPHI_VECTOR_SIZE 16
#  endif
typedef sph_real sphi_lanes
    __attribute__((vector_size(SPHI_VECTOR_SIZE), aligned(sizeof(sph_real)), may_alias));
enum { SPHI_LANES = SPHI_VECTOR_SIZE / sizeof(sph_real) };
#  define SPHI_LANE(v, l) (v)[l]
#else
#  define SPHI_VECTOR_SIZE 0
typedef sph_real sphi_lanes;
enum { SPHI_LANES = 1 };
#  define SPHI_LANE(v, l) (v)
#endif
/* clang-format on */

/* One pair at a time, fifty sums do not stay in registers. So neighbours are gathered into tiles, and a few
   sums at a time run over a tile. Loops of SPHI_BLOCK passes vectorise without a flag; a tile is filled up to
   a multiple of them with the target itself, without volume. */
enum { SPHI_TILE = 64, SPHI_BLOCK = 8 };
typedef struct sphi_tile {
    sph_real x[SPHI_TILE], y[SPHI_TILE], z[SPHI_TILE], g[SPHI_TILE], w[SPHI_TILE], df[SPHI_TILE];
} sphi_tile;

/* Gathers e = (x_j - x_i) / h_i, the test weights g and w, and f_j - f_i of up to SPHI_TILE neighbours. */
SPH_FN void sphi_tile_gather(int method, sph_kernel k, int dim, int with_f, sphi_tile *t, sph_vec x_i,
                             sph_real h_i, sph_real f_i, sph_points x, sph_scalars volume, sph_scalars f,
                             const SPH_GLOBAL sph_index *index, int n)
{
    const sph_real u = SPH_R(1) / h_i;
    int c, l;
    for (c = 0; c < n; c++) {
        const sph_index j = index[c];
        const sph_vec x_j = sphi_point(dim, x, j);
        t->x[c] = x_j.x;
        if (dim > 1) t->y[c] = x_j.y;
        if (dim > 2) t->z[c] = x_j.z;
        t->w[c] = sphi_at(volume, j);
        if (with_f) t->df[c] = sphi_at(f, j);
    }
    for (c = n; c % SPHI_BLOCK; c++) {
        t->x[c] = x_i.x;
        if (dim > 1) t->y[c] = x_i.y;
        if (dim > 2) t->z[c] = x_i.z;
        t->w[c] = SPH_R(0);
        if (with_f) t->df[c] = f_i;
    }
    for (c = 0; c < n; c += SPHI_BLOCK)
        for (l = c; l < c + SPHI_BLOCK; l++) {
            sph_vec e;
            sph_test_weights tw;
            e.x = t->x[l];
            e.y = dim > 1 ? t->y[l] : SPH_R(0);
            e.z = dim > 2 ? t->z[l] : SPH_R(0);
            e = sph_scale(u, sphi_separation(dim, x, e, x_i));
            tw = sphi_test_weights(method, k, dim, sph_length(dim, e), t->w[l]);
            t->x[l] = e.x;
            if (dim > 1) t->y[l] = e.y;
            if (dim > 2) t->z[l] = e.z;
            t->g[l] = tw.g;
            t->w[l] = tw.w;
            if (with_f) t->df[l] -= f_i;
        }
}

/* clang-format off */
#define SPHI_LANES_ZERO(from, name, formula) sphi_lanes name = zero;
#define SPHI_LANES_ADD(from, name, formula) if (dim >= from) name += formula;
#define SPHI_LANES_TOTAL(from, name, formula) \
    if (dim >= from) for (l = 0; l < SPHI_LANES; l++) m->name += SPHI_LANE(name, l);
#define SPHI_AT(array) (*(const sphi_lanes *)(array + c))
/* Adds a list of sums over a tile of n neighbours. */
#define SPHI_TILE_SUM(list) \
    { \
        list(SPHI_LANES_ZERO) \
        for (c = 0; c < n; c += SPHI_LANES) { \
            const sphi_lanes x = SPHI_AT(t->x), y = dim > 1 ? SPHI_AT(t->y) : zero, \
                             z = dim > 2 ? SPHI_AT(t->z) : zero, g = SPHI_AT(t->g), w = SPHI_AT(t->w), \
                             df = with_f ? SPHI_AT(t->df) : zero; \
            (void)x, (void)y, (void)z, (void)g, (void)w, (void)df; \
            list(SPHI_LANES_ADD) \
        } \
        list(SPHI_LANES_TOTAL) \
    }
/* clang-format on */

/* The moments of target i, as sph_moments_add and sph_moments_add_value make them. The last tile of its row
   stays in t. */
SPH_FN void sphi_moments(int method, sph_kernel k, int dim, int with_f, sph_index i, sph_points pos,
                         sph_list list, sph_real h_i, sph_scalars volume, sph_scalars f, sphi_tile *t,
                         sph_moments *m)
{
    const sph_vec x_i = sphi_point(dim, pos, i);
    const sph_real f_i = with_f ? sphi_at(f, i) : SPH_R(0);
    const sph_index end = list.start[i + 1];
#if SPHI_VECTOR_SIZE
    const sphi_lanes zero = {0};
#else
    const sphi_lanes zero = 0;
#endif
    sph_index left; /* It counts down, because an index beyond the last entry may not exist. */
    int l, c;
    *m = sph_moments_zero();
    for (left = end - list.start[i]; left > 0; left -= SPHI_TILE) {
        const int n = left < SPHI_TILE ? (int)left : (int)SPHI_TILE;
        sphi_tile_gather(method, k, dim, with_f, t, x_i, h_i, f_i, pos, volume, f, list.index + (end - left),
                         n);
        SPHI_TILE_SUM(SPHI_SUMS_GX)
        if (dim > 1) SPHI_TILE_SUM(SPHI_SUMS_GYZ)
        SPHI_TILE_SUM(SPHI_SUMS_WXX)
        if (dim > 1) SPHI_TILE_SUM(SPHI_SUMS_WXYZ)
        if (dim > 1) SPHI_TILE_SUM(SPHI_SUMS_WYZ)
        if (with_f) SPHI_TILE_SUM(SPHI_SUMS_VALUE)
    }
}

/* The number of unknowns that the neighbours must determine at once. CSPM solves for the gradient and then
   for the Hessian, the others solve for both together. */
SPH_FN int sphi_neighbours_needed(int method, int dim)
{
    return method == SPHI_CSPM ? sphi_unknowns(dim) : dim + sphi_unknowns(dim);
}

SPH_FN int sphi_solve(int method, int dim, const sph_moments *m, sph_real h, sph_jet *jet,
                      sph_real *conditioning)
{
    return method == SPHI_CSPM ? sph_solve_cspm(dim, m, h, jet, conditioning)
                               : sph_solve_block(dim, m, h, jet, conditioning);
}

/* Options of the sweeps for derivatives. Zeros are the defaults. */
typedef struct sph_derivatives_options {
    /* A target whose |conditioning| is smaller is SPH_ILL_CONDITIONED; >= 0. 0: no target is. */
    sph_real conditioning_min;
    /* For ICSPM and Fatehi-Manzari. 1: targets that are singular or ill-conditioned get the values of WLS. */
    int fallback_wls;
} sph_derivatives_options;

SPH_FN sph_index sphi_derivatives(int method, sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                  sph_derivatives_options options, sph_derivatives_out out)
{
    const size_t stride = sphi_stride(out.stride);
    const sph_real conditioning_min = options.conditioning_min;
    const int fallback_wls = method != SPHI_CSPM && method != SPHI_WLS && options.fallback_wls;
    const int want_conditioning = out.conditioning || conditioning_min > SPH_R(0);
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error && (!sphi_finite(conditioning_min) || conditioning_min < SPH_R(0)))
        error = sphi_refuse("conditioning_min", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real h_i = sphi_at(cloud.h, i);
        sphi_tile t;
        sph_moments m;
        sph_jet j;
        sph_real conditioning = SPH_R(0);
        int state, solved;
        sphi_moments(method, k, dim, 1, i, cloud.points, cloud.list, h_i, cloud.volume, f, &t, &m);
        state = sphi_solve(method, dim, &m, h_i, &j, want_conditioning ? &conditioning : 0);
        solved = state == SPH_OK;
        if (!sphi_finite(conditioning)) conditioning = SPH_R(0); /* the moments overflowed */
        if (!solved)
            state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i,
                                         sphi_neighbours_needed(method, dim));
        else if (want_conditioning && SPHI_ABS(conditioning) < conditioning_min) state = SPH_ILL_CONDITIONED;
        if (fallback_wls && (state == SPH_SINGULAR || state == SPH_ILL_CONDITIONED)) {
            sphi_moments(SPHI_WLS, k, dim, 1, i, cloud.points, cloud.list, h_i, cloud.volume, f, &t, &m);
            if (sph_solve_block(dim, &m, h_i, &j, 0) == SPH_OK) {
                state = SPH_FELL_BACK;
                solved = 1;
            }
        }
        if (solved && !(sphi_jet_finite(dim, j) && sphi_finite(sphi_trace(dim, j.hessian)))) {
            state = SPH_NOT_FINITE;
            solved = 0;
        }
        if (!solved) {
            j = sph_jet_laplacian(dim);
            j.hessian.xx = j.hessian.yy = j.hessian.zz = SPH_R(0);
        }
        sphi_put(out.gx, stride, i, j.gradient.x);
        sphi_put(out.hxx, stride, i, j.hessian.xx);
        if (dim > 1) {
            sphi_put(out.gy, stride, i, j.gradient.y);
            sphi_put(out.hxy, stride, i, j.hessian.xy);
            sphi_put(out.hyy, stride, i, j.hessian.yy);
        }
        if (dim > 2) {
            sphi_put(out.gz, stride, i, j.gradient.z);
            sphi_put(out.hxz, stride, i, j.hessian.xz);
            sphi_put(out.hyz, stride, i, j.hessian.yz);
            sphi_put(out.hzz, stride, i, j.hessian.zz);
        }
        sphi_put(out.laplacian, stride, i, sphi_trace(dim, j.hessian));
        sphi_put(out.conditioning, stride, i, conditioning);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* Gradient, Hessian and Laplacian (the trace of the Hessian) by CSPM:
       h grad f = K^-1 sum g e df,   h^2 hess = M^-1 (sum w e e df - A h grad f),
   in 1D (3.5) and (5.15) of the ICSPM paper. The gradient is exact for linear fields, the Hessian for
   quadratic fields in the interior of symmetric clouds only. The Hessian has an error O(1) at boundaries: in
   1D it is kappa f'' instead of f''. conditioning is the smallest pivot of the scaled matrices, in [0, 1]. A
   target below conditioning_min is SPH_ILL_CONDITIONED and keeps its values.
   All values are 0 where the neighbours do not determine them (SPH_TOO_FEW if the support holds fewer than 1,
   3 or 6 neighbours in 1D, 2D or 3D, else SPH_SINGULAR), and where one overflows (SPH_NOT_FINITE).
   Atlas: Laplacian exact for linear fields, inside lattices for cubic fields; order 2 inside lattices, 0 in
   disorder, 0 at boundaries.
   Atlas: Hessian exact for linear fields, inside lattices for cubic fields; order 2 inside lattices, 0 in
   disorder, 0 at boundaries. */
SPH_FN sph_index sph_derivatives_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                      sph_derivatives_options options, sph_derivatives_out out)
{
    return sphi_derivatives(SPHI_CSPM, k, dim, cloud, f, options, out);
}

/* Gradient, Hessian and Laplacian by ICSPM, the solution of the whole system: (5.17) of the ICSPM paper in
   1D. They are exact for quadratic fields wherever the system is not singular. conditioning is kappa in 1D,
   and sign(det kappa) / |kappa^-1| in general. A target whose |conditioning| is below conditioning_min is
   SPH_ILL_CONDITIONED and keeps its values. Where there are boundaries and disorder, 0.2 is a good
   conditioning_min in 1D, and 0.02 in 2D and 3D; 0 is the published method. With fallback_wls = 1, targets
   that are ill-conditioned or singular get the values of WLS and are SPH_FELL_BACK.
   Where there is no answer, the values and the status are as for CSPM, but with 2, 5 or 9 neighbours.
   Atlas: gradient exact for quadratic fields; order 2 inside lattices, 2 in disorder, 2 at boundaries.
   Atlas: Laplacian exact for quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries.
   Atlas: Hessian exact for quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries. */
SPH_FN sph_index sph_derivatives_icspm(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                       sph_derivatives_options options, sph_derivatives_out out)
{
    return sphi_derivatives(SPHI_ICSPM, k, dim, cloud, f, options, out);
}

/* Gradient, Hessian and Laplacian by Fatehi & Manzari 2011, Comput. Math. Appl. 61, 482: with
   B = -(sum V_j x_ij grad W)^-1 and <grad f> = sum V_j (f_j - f_i) B grad W,
       <lap f>_i = Bh : sum_j 2 V_j e grad W ((f_i - f_j) / r - e . <grad f>),   e = x_ij / r,
       Bh : [sum V_j r e e e grad W + (sum V_j e e grad W) . B . (sum V_j x_ij x_ij grad W)] = -1 (unit
       matrix),
   computed as the trace of the Hessian of the block system (see the chapter's opening; the paper has the
   Laplacian only). Exact for quadratic fields. In disordered clouds it is as accurate in the interior as WLS
   and keeps the signs of the weights, which ICSPM does not; at a boundary single particles come near
   det(kappa) = 0. conditioning, conditioning_min, fallback_wls and the status are as for ICSPM: with
   conditioning_min = 0 a particle with a large error there is SPH_OK.
   Atlas: Laplacian exact for quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries.
   Atlas: Hessian exact for quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries. */
SPH_FN sph_index sph_derivatives_fatehi_manzari(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                                sph_derivatives_options options, sph_derivatives_out out)
{
    return sphi_derivatives(SPHI_FATEHI_MANZARI, k, dim, cloud, f, options, out);
}

/* Gradient, Hessian and Laplacian by weighted least squares, the robust sibling of ICSPM. They are exact for
   quadratic fields. Where kernel and volumes are not negative, the matrix is definite wherever the neighbours
   determine a quadratic field, and conditioning, which is that of ICSPM, is in [0, 1]. conditioning_min, and
   the values and the status where there is no answer, are as for ICSPM; there is no fallback.
   Atlas: gradient exact for quadratic fields; order 2 inside lattices, 2 in disorder, 2 at boundaries.
   Atlas: Laplacian exact for quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries.
   Atlas: Hessian exact for quadratic fields, inside lattices for cubic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries. */
SPH_FN sph_index sph_derivatives_wls(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                     sph_derivatives_options options, sph_derivatives_out out)
{
    return sphi_derivatives(SPHI_WLS, k, dim, cloud, f, options, out);
}

SPH_FN sph_index sphi_derivative_rows(int method, sph_kernel k, int dim, sph_cloud cloud, sph_jet d,
                                      sph_rows_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error && !out.row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (!error && !sphi_jet_finite(dim, d)) error = sphi_refuse("d", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_index end = cloud.list.start[i + 1];
        const int many = end - cloud.list.start[i] > SPHI_TILE; /* Then the first tiles are gone. */
        SPH_GLOBAL sph_real *const row = out.row;
        sphi_tile t;
        sph_moments m;
        sph_coefficients c;
        sph_real conditioning = SPH_R(0), sum = SPH_R(0);
        int state;
        c.factor = SPH_R(0);
        sphi_moments(method, k, dim, 0, i, cloud.points, cloud.list, h_i, cloud.volume, cloud.volume, &t, &m);
        state = method == SPHI_CSPM
                    ? sph_coefficients_cspm(dim, &m, h_i, d, &c, out.conditioning ? &conditioning : 0)
                    : sph_coefficients_block(dim, method != SPHI_WLS, &m, h_i, d, &c,
                                             out.conditioning ? &conditioning : 0);
        if (state)
            state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i,
                                         sphi_neighbours_needed(method, dim));
        else {
            sph_index left;
            for (left = end - cloud.list.start[i]; left > 0; left -= SPHI_TILE) {
                const int n = left < SPHI_TILE ? (int)left : (int)SPHI_TILE;
                int b, l;
                if (many)
                    sphi_tile_gather(method, k, dim, 0, &t, x_i, h_i, SPH_R(0), cloud.points, cloud.volume,
                                     cloud.volume, cloud.list.index + (end - left), n);
                for (b = 0; b < n; b += SPHI_BLOCK)
                    for (l = b; l < b + SPHI_BLOCK; l++) {
                        sph_vec e;
                        sph_test_weights tw;
                        e.x = t.x[l];
                        e.y = dim > 1 ? t.y[l] : SPH_R(0);
                        e.z = dim > 2 ? t.z[l] : SPH_R(0);
                        tw.g = t.g[l];
                        tw.w = t.w[l];
                        t.g[l] = sph_coefficients_weight(dim, c, e, tw);
                    }
                for (l = 0; l < n; l++) {
                    row[end - left + l] = t.g[l];
                    sum += t.g[l];
                }
            }
            if (!sphi_finite(sum) || !sphi_finite(c.factor)) state = SPH_NOT_FINITE;
        }
        if (!sphi_finite(conditioning)) conditioning = SPH_R(0);
        if (state) {
            for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) row[p] = SPH_R(0);
            c.factor = sum = SPH_R(0);
        }
        sphi_put(out.diagonal, sphi_stride(out.stride), i, -sum);
        sphi_put(out.factor, sphi_stride(out.stride), i, c.factor);
        sphi_put(out.conditioning, sphi_stride(out.stride), i, conditioning);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* Rows of the operator d (see sph_jet) by CSPM: sum_p row[p] (f_j - f_i) = factor[i] D f_i with factor 1. It
   is exact for what sph_derivatives_cspm is exact for. The row of a target that is not SPH_OK is 0, and so is
   its factor. SPH_ERROR_VALUE for a d that is not finite. */
SPH_FN sph_index sph_derivatives_rows_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_jet d,
                                           sph_rows_out out)
{
    return sphi_derivative_rows(SPHI_CSPM, k, dim, cloud, d, out);
}

/* The same by ICSPM: sum_p row[p] (f_j - f_i) = factor[i] D f_i, exact for quadratic fields. The factor is
   the kappa of the paper. In 1D the rows are those of CSPM, and a boundary value problem u'' = b becomes
   sum_p row[p] (u_j - u_i) = kappa_i b(x_i). Nothing is ever divided by kappa, so that a target where kappa
   is 0 is SPH_OK here. */
SPH_FN sph_index sph_derivatives_rows_icspm(sph_kernel k, int dim, sph_cloud cloud, sph_jet d,
                                            sph_rows_out out)
{
    return sphi_derivative_rows(SPHI_ICSPM, k, dim, cloud, d, out);
}
/* The same by Fatehi & Manzari, exact for quadratic fields, with a factor as for ICSPM: the row of the paper
   is row[p] / factor[i]. */
SPH_FN sph_index sph_derivatives_rows_fatehi_manzari(sph_kernel k, int dim, sph_cloud cloud, sph_jet d,
                                                     sph_rows_out out)
{
    return sphi_derivative_rows(SPHI_FATEHI_MANZARI, k, dim, cloud, d, out);
}
/* The same by WLS, exact for quadratic fields, with factor 1. */
SPH_FN sph_index sph_derivatives_rows_wls(sph_kernel k, int dim, sph_cloud cloud, sph_jet d, sph_rows_out out)
{
    return sphi_derivative_rows(SPHI_WLS, k, dim, cloud, d, out);
}

/* -------- BIM (boundary integrals), one dimension */

/* The weight of (f_b - f_i) for the end b of the domain at x_b, before the division by gamma_i:
       2 normal W(x_i - x_b) / (x_b - x_i)   with   e = x_b - x_i.
   The outer normal is +1 at the right end and -1 at the left end, so that the weight is positive inside.
   Sources: Macia, Gonzalez, Cercos-Pita & Souto-Iglesias 2012, Prog. Theor. Phys. 128, 439; (4.9) of the
   ICSPM paper, where the braces are lost in print: the factor 2 / gamma multiplies the boundary terms, too.
   Needs normal = 1 and e > 0, or normal = -1 and e < 0: at the end itself (e = 0) the term is undefined. */
SPH_FN sph_real sph_boundary_weight_bim(sph_kernel k, sph_real e, sph_real normal, sph_real h)
{
    SPH_ASSERT((normal == SPH_R(1) && e > SPH_R(0)) || (normal == SPH_R(-1) && e < SPH_R(0)));
    return SPH_R(2) * normal * sph_kernel_w(k, 1, SPHI_ABS(e), h) / e;
}

SPH_FN int sphi_check_ends(sph_points x, sph_index left, sph_index right)
{
    if (x.box.x > SPH_R(0)) return sphi_refuse("box", -1, SPH_ERROR_BOX); /* A periodic axis has no ends. */
    if (left < 0 || left >= x.n || right < 0 || right >= x.n)
        return sphi_refuse("left, right", -1, SPH_ERROR_RANGE);
    return x.x[(size_t)left * x.stride] < x.x[(size_t)right * x.stride]
               ? 0
               : sphi_refuse("left, right", left, SPH_ERROR_POSITION);
}
/* SPH_NOT_AVAILABLE at or beyond the ends. SPH_TOO_FEW without a neighbour inside the support, because the
   sum would then be 0 without notice. */
SPH_FN int sphi_bim_status(sph_kernel k, sph_index i, sph_points x, sph_list list, sph_real h,
                           sph_real x_left, sph_real x_right)
{
    const sph_real x_i = sphi_point(1, x, i).x;
    if (!(x_i > x_left && x_i < x_right)) return SPH_NOT_AVAILABLE;
    return sphi_singular_status(k, 1, i, x, list, h, 1) == SPH_TOO_FEW ? SPH_TOO_FEW : SPH_OK;
}

/* The second derivative in 1D by boundary integrals, where `left` and `right` are the particles at the ends:
       f''_i = (1/gamma_i) { sum_j 2 V_j (f_i - f_j) F_ij + sum_b weight_b (f_b - f_i) },
   with the Shepard sum gamma_i, b = left, right, and weight_b from sph_boundary_weight_bim. Source: (5.16) of
   the ICSPM paper. It is exact for constants. Near a boundary the error is of first order if h grows relative
   to the spacing, as the integrals require.
   The result is 0 at and beyond the ends (SPH_NOT_AVAILABLE), without a neighbour inside the support
   (SPH_TOO_FEW), and where it overflows (SPH_NOT_FINITE). SPH_ERROR_BOX for a periodic axis, SPH_ERROR_RANGE
   if an end is not a particle, SPH_ERROR_POSITION if left is not to the left of right. */
SPH_FN sph_index sph_second_derivative_bim(sph_kernel k, sph_cloud cloud, sph_scalars f, sph_index left,
                                           sph_index right, sph_scalar_out out)
{
    int error = sphi_check_sweep(k, 1, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_ends(cloud.points, left, right);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real x_i = sphi_point(1, cloud.points, i).x, x_l = sphi_point(1, cloud.points, left).x,
                       x_r = sphi_point(1, cloud.points, right).x, h_i = sphi_at(cloud.h, i),
                       f_i = sphi_at(f, i);
        int state = sphi_bim_status(k, i, cloud.points, cloud.list, h_i, x_l, x_r);
        sph_real value = SPH_R(0);
        if (!state) {
            sph_real sum = SPH_R(0), gamma = sphi_at(cloud.volume, i) * sph_kernel_w(k, 1, SPH_R(0), h_i);
            SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum, gamma) {
                const sph_index j = cloud.list.index[p];
                const sph_real r = SPHI_ABS(x_i - sphi_point(1, cloud.points, j).x);
                sum += sph_laplacian_weight_brookshaw(k, 1, r, h_i, sphi_at(cloud.volume, j)) *
                       (sphi_at(f, j) - f_i);
                gamma += sphi_at(cloud.volume, j) * sph_kernel_w(k, 1, r, h_i);
            }
            sum += sph_boundary_weight_bim(k, x_r - x_i, SPH_R(1), h_i) * (sphi_at(f, right) - f_i) +
                   sph_boundary_weight_bim(k, x_l - x_i, SPH_R(-1), h_i) * (sphi_at(f, left) - f_i);
            value = sum / gamma;
            if (!sphi_finite(value)) {
                value = SPH_R(0);
                state = SPH_NOT_FINITE;
            }
        }
        failed += sphi_answer(out, i, value, state);
    }
    return failed;
}

/* The same as rows: f''_i = sum_p row[p] (f_j - f_i), with factor 1. The ends left and right must be in the
   lists of the targets whose support reaches them. The row of a target that is not SPH_OK is 0. */
SPH_FN sph_index sph_second_derivative_rows_bim(sph_kernel k, sph_cloud cloud, sph_index left,
                                                sph_index right, sph_rows_out out)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT row = out.row;
    int error = sphi_check_sweep(k, 1, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error && !row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_ends(cloud.points, left, right);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real x_i = sphi_point(1, cloud.points, i).x, x_l = sphi_point(1, cloud.points, left).x,
                       x_r = sphi_point(1, cloud.points, right).x, h_i = sphi_at(cloud.h, i);
        int state = sphi_bim_status(k, i, cloud.points, cloud.list, h_i, x_l, x_r);
        sph_real gamma = sphi_at(cloud.volume, i) * sph_kernel_w(k, 1, SPH_R(0), h_i), scale;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sph_real r = SPHI_ABS(x_i - sphi_point(1, cloud.points, j).x);
            row[p] =
                state ? SPH_R(0) : sph_laplacian_weight_brookshaw(k, 1, r, h_i, sphi_at(cloud.volume, j));
            if (!state && j == right) row[p] += sph_boundary_weight_bim(k, x_r - x_i, SPH_R(1), h_i);
            if (!state && j == left) row[p] += sph_boundary_weight_bim(k, x_l - x_i, SPH_R(-1), h_i);
            gamma += sphi_at(cloud.volume, j) * sph_kernel_w(k, 1, r, h_i);
        }
        scale = state ? SPH_R(0) : SPH_R(1) / gamma;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) row[p] *= scale;
        if (sphi_row_finite(row, cloud.list.start[i], cloud.list.start[i + 1])) state = SPH_NOT_FINITE;
        sphi_row_answer(out, cloud.list, i, 1, SPH_R(1), state);
        failed += state != SPH_OK;
    }
    return failed;
}

/* ================================================================ linear fits
 *
 * Value and gradient of a field at points that need not be particles: probes, gauges, mirror points of walls,
 * new particles, the particles of another code. With e = (x_j - x) / h, from the target x to a source j,
 *     f_j = f + e . (h grad f) + ...
 * is summed against the test functions w and g e_a:
 *     [ sum w        sum w e_b     ] [ f         ]   [ sum w f_j     ]
 *     [ sum g e_a    sum g e_a e_b ] [ h d_b f   ] = [ sum g e_a f_j ].
 *   MLS   g = w = V_j W: moving least squares, a weighted fit of a linear field. Definite wherever the
 *         neighbours determine a linear field. Lancaster & Salkauskas 1981, Math. Comput. 37, 141.
 *   Liu   w = V_j W and g = -V_j F, that is, the test functions W and grad W. Liu & Liu 2006, Appl. Numer.
 *         Math. 56, 19. Walls by mirror points (mDBC) use it: English et al. 2022, Comput. Part. Mech. 9,
 *         911.
 * Exact for linear fields, with any cloud and volumes, also outside of the cloud; the error is O(h^2). Values
 * are differences from that of one neighbour, so that a constant is reproduced without rounding.
 *
 * The fallback is Shepard's mean sum w f_j / sum w with the gradient 0 (SPH_FELL_BACK): where fewer than
 * dim + 1 neighbours are inside the support, where they lie on a line or in a plane, or where the
 * conditioning is below the least that is asked for. Without a neighbour inside the support, all is 0
 * (SPH_TOO_FEW).
 *
 * Targets and sources are two clouds. The lists come from a search with SPH_LIST_FOREIGN:
 *     sph_query query = sph_query_of(probes, SPH_GATHER, radius, SPH_LIST_FOREIGN);
 * A source with the volume 0 does not count: so a cloud of fluid and walls is asked for its fluid alone. Both
 * clouds may be the same points; a list then holds the point itself with SPH_LIST_SELF only.
 */

/* The sums, as those of the second derivatives. */
/* clang-format off */
#define SPHI_SUMS_FIT_W(X) X(1, w1, w) X(1, wx, w * x) X(2, wy, w * y) X(3, wz, w * z)
#define SPHI_SUMS_FIT_G(X) \
    X(1, gx, g * x) X(1, gxx, g * x * x) X(2, gy, g * y) X(2, gxy, g * x * y) X(2, gyy, g * y * y) \
    X(3, gz, g * z) X(3, gxz, g * x * z) X(3, gyz, g * y * z) X(3, gzz, g * z * z)
#define SPHI_SUMS_FIT_VALUE(X) \
    X(1, wf, w * df) X(1, gfx, g * df * x) X(2, gfy, g * df * y) X(3, gfz, g * df * z)
/* clang-format on */

/* The sums of one target: gxy is sum g e_x e_y, and so on. wf, gfx, ... are the right-hand side. */
typedef struct sph_fit {
    SPHI_SUMS_FIT_W(SPHI_FIELD)
    SPHI_SUMS_FIT_G(SPHI_FIELD)
    SPHI_SUMS_FIT_VALUE(SPHI_FIELD)
} sph_fit;

/* All sums are 0. */
SPH_FN sph_fit sph_fit_zero(void)
{
    sph_fit s;
    SPHI_SUMS_FIT_W(SPHI_ZERO)
    SPHI_SUMS_FIT_G(SPHI_ZERO)
    SPHI_SUMS_FIT_VALUE(SPHI_ZERO)
    return s;
}
/* Adds what a neighbour contributes to the matrix: w, w e, g e and g e e. e is (x_j - x) / h; t comes from
   sph_test_weights_wls (for MLS) or sph_test_weights_liu. */
SPH_FN void sph_fit_add(int dim, sph_fit *s, sph_vec e, sph_test_weights t)
{
    const sph_real x = e.x, y = e.y, z = e.z, g = t.g, w = t.w;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    SPHI_SUMS_FIT_W(SPHI_ADD)
    SPHI_SUMS_FIT_G(SPHI_ADD)
}
/* Adds what a neighbour contributes to the right-hand side: w df and g e df. df is the value f_j, or its
   difference from a number that is added to the value of the fit. */
SPH_FN void sph_fit_add_value(int dim, sph_fit *s, sph_vec e, sph_test_weights t, sph_real df)
{
    const sph_real x = e.x, y = e.y, z = e.z, g = t.g, w = t.w;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    SPHI_SUMS_FIT_VALUE(SPHI_ADD)
}

/* The coefficients of a row: the weight of f_j is w level + g linear . e. */
typedef struct sph_fit_row {
    sph_real level;
    sph_vec linear;
} sph_fit_row;
/* The rows of the value and of the derivatives d_x f, d_y f, d_z f. Those beyond dim are 0. */
typedef struct sph_fit_rows {
    sph_fit_row value, x, y, z;
} sph_fit_rows;

SPH_FN sph_fit_row sphi_fit_row(int dim, const sph_real *scale, const sph_real *y, int columns, sph_real by)
{
    sph_fit_row r;
    r.level = by * scale[0] * y[0];
    r.linear.x = by * scale[1] * y[columns];
    r.linear.y = dim > 1 ? by * scale[2] * y[2 * columns] : SPH_R(0);
    r.linear.z = dim > 2 ? by * scale[3] * y[3 * columns] : SPH_R(0);
    return r;
}
/* The rows of a linear fit. Returns SPH_OK, or SPH_SINGULAR and then writes nothing. *conditioning is the
   smallest pivot of the matrix scaled to a unit diagonal (1 good, 0 singular); the pointer may be null. */
SPH_FN int sph_solve_fit(int dim, const sph_fit *s, sph_real h, sph_fit_rows *rows, sph_real *conditioning)
{
    const int n = sphi_dimensions(dim) + 1;
    sph_real scale[4], y[4 * 4];
    sphi_lu lu;
    int i, j;
    SPH_ASSERT(SPHI_IS_DIM(dim) && h > SPH_R(0));
    /* The transposed matrix: a row of the fit is a column of it. */
    lu.a[0][0] = s->w1;
    lu.a[1][0] = s->wx;
    lu.a[0][1] = s->gx;
    lu.a[1][1] = s->gxx;
    if (dim > 1) {
        lu.a[2][0] = s->wy;
        lu.a[0][2] = s->gy;
        lu.a[1][2] = lu.a[2][1] = s->gxy;
        lu.a[2][2] = s->gyy;
    }
    if (dim > 2) {
        lu.a[3][0] = s->wz;
        lu.a[0][3] = s->gz;
        lu.a[1][3] = lu.a[3][1] = s->gxz;
        lu.a[2][3] = lu.a[3][2] = s->gyz;
        lu.a[3][3] = s->gzz;
    }
    for (i = 0; i < n; i++) {
        if (!(lu.a[i][i] > SPH_R(0))) return SPH_SINGULAR;
        scale[i] = SPH_R(1) / SPHI_SQRT(lu.a[i][i]);
    }
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) {
            lu.a[i][j] *= scale[i] * scale[j];
            y[i * n + j] = i == j ? scale[j] : SPH_R(0);
        }
    sphi_lu_factor(n, &lu);
    if (!(lu.pivot_min > SPHI_PIVOT_MIN)) return SPH_SINGULAR;
    sphi_lu_solve_columns(n, &lu, n, y);
    rows->value = sphi_fit_row(dim, scale, y, n, SPH_R(1));
    rows->x = sphi_fit_row(dim, scale, y + 1, n, SPH_R(1) / h);
    rows->y = sphi_fit_row(dim, scale, y + (dim > 1 ? 2 : 0), n, dim > 1 ? SPH_R(1) / h : SPH_R(0));
    rows->z = sphi_fit_row(dim, scale, y + (dim > 2 ? 3 : 0), n, dim > 2 ? SPH_R(1) / h : SPH_R(0));
    if (conditioning) *conditioning = lu.pivot_min;
    return SPH_OK;
}
/* No weight for anyone. */
SPH_FN sph_fit_rows sphi_fit_none(void)
{
    sph_fit_rows rows;
    rows.x.level = rows.x.linear.x = rows.x.linear.y = rows.x.linear.z = SPH_R(0);
    rows.value = rows.y = rows.z = rows.x;
    return rows;
}
/* The rows of Shepard's mean: each value has the weight w / sum w, and the gradient is 0. Needs sum w > 0. */
SPH_FN sph_fit_rows sph_fit_shepard(const sph_fit *s)
{
    sph_fit_rows rows = sphi_fit_none();
    SPH_ASSERT(s->w1 > SPH_R(0));
    rows.value.level = SPH_R(1) / s->w1;
    return rows;
}
/* The weight of f_j in the row, of the neighbour at e = (x_j - x) / h whose test weights are t. */
SPH_FN sph_real sph_fit_weight(int dim, sph_fit_row row, sph_vec e, sph_test_weights t)
{
    SPH_ASSERT(SPHI_IS_DIM(dim));
    return t.w * row.level + t.g * sph_dot(dim, row.linear, e);
}
/* The row applied to the values whose sums are in s. */
SPH_FN sph_real sph_fit_value(int dim, sph_fit_row row, const sph_fit *s)
{
    sph_real value = row.level * s->wf + row.linear.x * s->gfx;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    if (dim > 1) value += row.linear.y * s->gfy;
    if (dim > 2) value += row.linear.z * s->gfz;
    return value;
}
/* f + away . grad f, the field at the distance `away` from where it has this value and gradient: at a wall
   particle x_w from its mirror point x_g, away = x_w - x_g (mDBC). */
SPH_FN sph_real sph_fit_extend(int dim, sph_real value, sph_vec gradient, sph_vec away)
{
    return value + sph_dot(dim, away, gradient);
}

/* -------- linear fits: sweeps */

/* The sources of a fit: points, and the volumes that weigh them. */
typedef struct sph_sources {
    sph_points points;
    sph_scalars volume;
} sph_sources;
typedef struct sph_interpolation_options {
    /* A target whose conditioning is smaller gets Shepard's mean; >= 0. 0: only singular ones do. 0.001 keeps
       a fit from extrapolating far with neighbours that are nearly on a line. */
    sph_real conditioning_min;
} sph_interpolation_options;
/* Where value and gradient go. What is null is not wanted. status holds an sph_status of each target, and is
   contiguous. */
typedef struct sph_interpolation_out {
    SPH_GLOBAL sph_real *value, *gx, *gy, *gz, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_interpolation_out;
/* Where rows go: one weight for each entry of the list, for the value and for each component of the gradient,
   contiguous: f = sum_p value[p] f_j, grad f = sum_p (x[p], y[p], z[p]) f_j. What is null is not wanted. The
   stride is that of conditioning. */
typedef struct sph_interpolation_rows_out {
    SPH_GLOBAL sph_real *value, *x, *y, *z, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_interpolation_rows_out;

SPH_FN int sphi_check_fit(sph_kernel k, int dim, sph_cloud targets_of, sph_sources sources,
                          sph_interpolation_options options)
{
    sph_real largest = SPH_R(0);
    int error = sphi_check_frame(dim, targets_of);
    if (error >= 0 && sphi_check_kernel(k)) return SPH_ERROR_KERNEL;
    if (!error && sources.points.n < 0) error = sphi_refuse("sources.n", -1, SPH_ERROR_COUNT);
    if (!error && sources.points.n > 0) error = sphi_check_arrays(dim, sources.points);
    if (!error && !targets_of.h.p) error = sphi_refuse("h", -1, SPH_ERROR_NULL);
    if (!error && sources.points.n > 0 && !sources.volume.p)
        error = sphi_refuse("volume", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_h("h", targets_of.h, targets_of.points.n, &largest);
    if (!error && sources.points.n > 0)
        error = sphi_check_finite("volume", sources.volume, sources.points.n, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_positions(dim, targets_of.points);
    if (!error && sources.points.n > 0) error = sphi_check_positions(dim, sources.points);
    largest *= sph_kernel_support_ratio(k);
    targets_of.points.box = sources.points.box;
    if (!error) error = sphi_check_box(dim, targets_of.points, largest, 0);
    if (!error) error = sphi_check_box(dim, sources.points, largest, 0);
    if (!error)
        error = sphi_check_entries(targets_of.first, targets_of.last, targets_of.list, sources.points.n, 1);
    if (!error && (!sphi_finite(options.conditioning_min) || options.conditioning_min < SPH_R(0)))
        error = sphi_refuse("conditioning_min", -1, SPH_ERROR_VALUE);
    return error;
}

/* The sums of target i, as sph_fit_add and sph_fit_add_value make them. The last tile stays in t. The values
   are those of f less *reference, the value of a neighbour that counts. */
SPH_FN void sphi_fit_sums(int method, sph_kernel k, int dim, int with_f, sph_index i, sph_cloud targets_of,
                          sph_sources sources, sph_scalars f, sph_real *reference, sphi_tile *t, sph_fit *m)
{
    const sph_vec x_i = sphi_point(dim, targets_of.points, i);
    const sph_real h_i = sphi_at(targets_of.h, i);
    const sph_list list = targets_of.list;
    const sph_index end = list.start[i + 1];
#if SPHI_VECTOR_SIZE
    const sphi_lanes zero = {0};
#else
    const sphi_lanes zero = 0;
#endif
    sph_index left;
    int l, c;
    *m = sph_fit_zero();
    *reference = SPH_R(0);
    for (left = list.start[i]; with_f && left < end; left++)
        if (sphi_at(sources.volume, list.index[left]) != SPH_R(0)) {
            *reference = sphi_at(f, list.index[left]);
            break;
        }
    for (left = end - list.start[i]; left > 0; left -= SPHI_TILE) {
        const int n = left < SPHI_TILE ? (int)left : (int)SPHI_TILE;
        sphi_tile_gather(method, k, dim, with_f, t, x_i, h_i, *reference, sources.points, sources.volume, f,
                         list.index + (end - left), n);
        SPHI_TILE_SUM(SPHI_SUMS_FIT_W)
        SPHI_TILE_SUM(SPHI_SUMS_FIT_G)
        if (with_f) SPHI_TILE_SUM(SPHI_SUMS_FIT_VALUE)
    }
}
/* The rows of a target, or those of the fallback, and its status. */
SPH_FN int sphi_fit_solve(int dim, const sph_fit *s, sph_real h, sph_real conditioning_min,
                          sph_fit_rows *rows, sph_real *conditioning)
{
    *rows = sphi_fit_none();
    *conditioning = SPH_R(0);
    if (sph_solve_fit(dim, s, h, rows, conditioning) == SPH_OK && *conditioning >= conditioning_min)
        return SPH_OK;
    if (!(s->w1 > SPH_R(0))) return sphi_finite(s->w1) ? SPH_TOO_FEW : SPH_NOT_FINITE;
    *rows = sph_fit_shepard(s);
    return SPH_FELL_BACK;
}

SPH_FN sph_index sphi_interpolate(int method, sph_kernel k, int dim, sph_cloud targets_of,
                                  sph_sources sources, sph_scalars f, sph_interpolation_options options,
                                  sph_interpolation_out out)
{
    const size_t stride = sphi_stride(out.stride);
    int error = sphi_check_fit(k, dim, targets_of, sources, options);
    sph_index i, failed = 0;
    if (!error && sources.points.n > 0) error = sphi_check_field("f", f, sources.points.n);
    if (error) return sphi_answer_of(error);
    for (i = targets_of.first; i < targets_of.last; i++) {
        sphi_tile t;
        sph_fit s;
        sph_fit_rows rows;
        sph_real conditioning, value = SPH_R(0);
        sph_vec g = {SPH_R(0), SPH_R(0), SPH_R(0)};
        int state;
        sphi_fit_sums(method, k, dim, 1, i, targets_of, sources, f, &value, &t, &s);
        state =
            sphi_fit_solve(dim, &s, sphi_at(targets_of.h, i), options.conditioning_min, &rows, &conditioning);
        if (!sphi_unanswered(state)) {
            value += sph_fit_value(dim, rows.value, &s);
            g.x = sph_fit_value(dim, rows.x, &s);
            if (dim > 1) g.y = sph_fit_value(dim, rows.y, &s);
            if (dim > 2) g.z = sph_fit_value(dim, rows.z, &s);
            if (!sphi_finite(value) || !sphi_finite(g.x) || !sphi_finite(g.y) || !sphi_finite(g.z))
                state = SPH_NOT_FINITE;
        }
        if (sphi_unanswered(state)) value = g.x = g.y = g.z = SPH_R(0);
        sphi_put(out.value, stride, i, value);
        sphi_put(out.gx, stride, i, g.x);
        if (dim > 1) sphi_put(out.gy, stride, i, g.y);
        if (dim > 2) sphi_put(out.gz, stride, i, g.z);
        sphi_put(out.conditioning, stride, i, conditioning);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* Value and gradient of f at the targets of another cloud, by moving least squares (see the chapter's
   opening): exact for linear fields, error O(h^2), any cloud. Of targets_of, the points, lists, h and range
   are read: lists hold every source with r < support of the target (SPH_GATHER with SPH_LIST_FOREIGN). f has
   one value for each source. The box is that of the sources. conditioning is that of sph_solve_fit. The
   states of targets are SPH_OK, SPH_FELL_BACK (Shepard's mean, gradient 0), SPH_TOO_FEW (nothing inside the
   support) and SPH_NOT_FINITE; for the last two all is 0. Returns the number of targets that are not SPH_OK,
   or a negative sph_error.
   Atlas: value exact for linear fields; order 2 inside lattices, 2 in disorder, 2 at boundaries.
   Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries. */
SPH_FN sph_index sph_interpolate_mls(sph_kernel k, int dim, sph_cloud targets_of, sph_sources sources,
                                     sph_scalars f, sph_interpolation_options options,
                                     sph_interpolation_out out)
{
    return sphi_interpolate(SPHI_WLS, k, dim, targets_of, sources, f, options, out);
}
/* The same by Liu & Liu's test functions W and grad W, as walls by mirror points (mDBC) do it: the targets
   are the mirror points, and sph_fit_extend carries value and gradient from there to the wall particles. mDBC
   falls back where the determinant is below 0.001: its conditioning_min.
   Atlas: value exact for linear fields; order 2 inside lattices, 2 in disorder, 2 at boundaries. */
SPH_FN sph_index sph_interpolate_liu(sph_kernel k, int dim, sph_cloud targets_of, sph_sources sources,
                                     sph_scalars f, sph_interpolation_options options,
                                     sph_interpolation_out out)
{
    return sphi_interpolate(SPHI_LIU, k, dim, targets_of, sources, f, options, out);
}

SPH_FN sph_index sphi_interpolate_rows(int method, sph_kernel k, int dim, sph_cloud targets_of,
                                       sph_sources sources, sph_interpolation_options options,
                                       sph_interpolation_rows_out out)
{
    const sph_list list = targets_of.list;
    int error = sphi_check_fit(k, dim, targets_of, sources, options);
    sph_index i, p, failed = 0;
    if (error) return sphi_answer_of(error);
    for (i = targets_of.first; i < targets_of.last; i++) {
        const sph_vec x_i = sphi_point(dim, targets_of.points, i);
        const sph_real h_i = sphi_at(targets_of.h, i);
        const sph_index end = list.start[i + 1];
        const int many = end - list.start[i] > SPHI_TILE; /* Then the first tiles are gone. */
        sphi_tile t;
        sph_fit s;
        sph_fit_rows rows;
        sph_real conditioning, none, sum = SPH_R(0);
        sph_index left;
        int state, c;
        sphi_fit_sums(method, k, dim, 0, i, targets_of, sources, sources.volume, &none, &t, &s);
        state = sphi_fit_solve(dim, &s, h_i, options.conditioning_min, &rows, &conditioning);
        for (left = sphi_unanswered(state) ? 0 : end - list.start[i]; left > 0; left -= SPHI_TILE) {
            const int n = left < SPHI_TILE ? (int)left : (int)SPHI_TILE;
            const sph_index at = end - left;
            if (many)
                sphi_tile_gather(method, k, dim, 0, &t, x_i, h_i, SPH_R(0), sources.points, sources.volume,
                                 sources.volume, list.index + at, n);
            for (c = 0; c < n; c++) {
                sph_vec e;
                sph_test_weights tw;
                sph_real weight, x, y = SPH_R(0), z = SPH_R(0);
                e.x = t.x[c];
                e.y = dim > 1 ? t.y[c] : SPH_R(0);
                e.z = dim > 2 ? t.z[c] : SPH_R(0);
                tw.g = t.g[c];
                tw.w = t.w[c];
                weight = sph_fit_weight(dim, rows.value, e, tw);
                x = sph_fit_weight(dim, rows.x, e, tw);
                if (dim > 1) y = sph_fit_weight(dim, rows.y, e, tw);
                if (dim > 2) z = sph_fit_weight(dim, rows.z, e, tw);
                sum += SPHI_ABS(weight) + SPHI_ABS(x) + SPHI_ABS(y) + SPHI_ABS(z);
                if (out.value) out.value[at + c] = weight;
                if (out.x) out.x[at + c] = x;
                if (dim > 1 && out.y) out.y[at + c] = y;
                if (dim > 2 && out.z) out.z[at + c] = z;
            }
        }
        if (!sphi_finite(sum)) state = SPH_NOT_FINITE;
        for (p = sphi_unanswered(state) ? list.start[i] : end; p < end; p++) {
            if (out.value) out.value[p] = SPH_R(0);
            if (out.x) out.x[p] = SPH_R(0);
            if (dim > 1 && out.y) out.y[p] = SPH_R(0);
            if (dim > 2 && out.z) out.z[p] = SPH_R(0);
        }
        sphi_put(out.conditioning, sphi_stride(out.stride), i, conditioning);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}
/* The value and gradient of sph_interpolate_mls as rows, for many fields of the same particles, and for
   matrices: f = sum_p value[p] f_j, grad f = sum_p (x[p], y[p], z[p]) f_j, p along the list of the target.
   The rows of the value have the sum 1, those of the gradient 0. The rows of a target that is SPH_TOO_FEW or
   SPH_NOT_FINITE are 0. */
SPH_FN sph_index sph_interpolate_rows_mls(sph_kernel k, int dim, sph_cloud targets_of, sph_sources sources,
                                          sph_interpolation_options options, sph_interpolation_rows_out out)
{
    return sphi_interpolate_rows(SPHI_WLS, k, dim, targets_of, sources, options, out);
}
/* Those of sph_interpolate_liu. */
SPH_FN sph_index sph_interpolate_rows_liu(sph_kernel k, int dim, sph_cloud targets_of, sph_sources sources,
                                          sph_interpolation_options options, sph_interpolation_rows_out out)
{
    return sphi_interpolate_rows(SPHI_LIU, k, dim, targets_of, sources, options, out);
}

/* ================================================================ elliptic operator
 *
 * L u = div(m grad u) as a sum of two-point fluxes. m is the mobility (conductivity, permeability,
 * diffusivity). Let e = x_j - x_i = -x_ij, which points from the particle to its neighbour, and let g_ij
 * be grad_i W_ij = -F_ij e, or another gradient of the kernel (sph_elliptic_gradient). Then
 *     L u_i = sum_j T_ij (u_j - u_i),   T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij),
 *     t_ij  = e . g_ij / |e|^2,         mu_ij = m_i + m_j.
 * scale_i and xi_i follow from the moments of the neighbourhood of particle i:
 *     Gamma = sum V_j t e e^T,   K = sum V_j e g^T = C^-1,   N = sum V_j g,   N~ = sum V_j t e
 *     Brookshaw             scale = 1                    xi = 0
 *     corrected Brookshaw   scale = tr K^-1 / dim        xi = 0
 *     Schwaiger             scale = tr Gamma^-1 / dim    xi = K^-1 N
 *     M-SPH                 scale = tr Gamma^-1 / dim    xi = K^-1 N~
 *     Basic-Degiuli-Ban     scale = dim / tr Gamma*      xi = K^-1 N~,   with g = W e in all of them
 * On request M-SPH takes Gamma* = Gamma - sum V_j (xi . g) e e^T in the place of Gamma
 * (options.gamma_star).
 *
 * Sources: Lukyanov & Vuik 2020, arXiv:1711.11351, (27), (51), (52), (69) for the four schemes, and (24),
 * (53), (55), (65), (71) for the moments. T_ij is their meshless transmissibility (90). Brookshaw 1985,
 * Proc. ASA 6, 207. Schwaiger 2008, IJNME 75, 647. Basic, Degiuli & Ban 2018, JCP 354, 269: theirs is
 *     lap u = 2 dim sum W (u_j - u_i) (1 - e . C o) / sum W |e|^2 (1 - e . C o),  o = sum W e,
 *     C = (sum W e e^T)^-1,
 * for particles of equal volume. Here volumes weigh W, and m_i + m_j takes the place of the factor 2.
 *
 * Exact for:
 *   Brookshaw            constants only.
 *   corrected Brookshaw  linear fields where N = 0.
 *   Schwaiger, M-SPH     with constant m: linear fields at every particle, for any positions and volumes;
 *                        in the interior of lattices also xx, xy, yy and cubic fields.
 *   Basic-Degiuli-Ban    the same, and |x|^2 at every particle.
 * Only the trace of the second derivatives is normalised (nearly: see options.trace). In disorder and at a
 * boundary, the pointwise errors are therefore O(1) for the last three, and O(1/h) for the first two.
 * Signs: no eigenvalue of L has a positive real part where all T >= 0, that is, where 1 - xi . e > 0 ((92),
 * (93); sph_elliptic_diagnose tells). The equation (1) of the paper is -L u - g.
 *
 * Misprints and misreadings that are corrected here:
 *   - Schwaiger's scheme (52) has the two-point form, too, because m_j u_j - m_i u_i - u_i (m_j - m_i) +
 *     m_i (u_j - u_i) = (m_i + m_j) (u_j - u_i). For the radial gradients (15), (17), (18) we have N = N~,
 *     so that Schwaiger's scheme and M-SPH give the same numbers, for any cloud and any m.
 *   - (91) has the wrong sign of G.
 *   - (71) as printed starts with C^-1, which is not Gamma for the gradient (16). Here it
 *     starts with Gamma.
 *   - The factor of the cubic spline under (12) is 2/3 in 1D, not 3/2.
 *   - (70) asks whether Gamma* is 0. It must be definite.
 *   - (69) with a matrix M is inconsistent unless all neighbours lie on the axes
 *     (examples/papers/elliptic_msph_diagonal.h). sph_elliptic_rows_anisotropic is consistent.
 * tests/test_elliptic.c shows that the printed forms fail.
 */

/* -------- elliptic operator: types and pair functions */

/* The gradient of the kernel that is taken for g. nu_i = sum_j V_j W_ij, with the particle itself. All but
   SPH_GRADIENT_FULL are radial, that is, parallel to e. */
typedef enum sph_elliptic_gradient {
    SPH_GRADIENT_DIFFUSE,         /* (15) grad W */
    SPH_GRADIENT_FULL,            /* (16) grad (W / nu). Best for M-SPH at boundaries */
    SPH_GRADIENT_SHEPARD_DIFFUSE, /* (17) (grad W) / nu */
    SPH_GRADIENT_SHEPARD_FULL     /* (18) grad_j (W / nu): of nu, only the neighbour's part varies */
} sph_elliptic_gradient;

#define SPHI_IS_GRADIENT(gradient) ((gradient) >= 0 && (gradient) <= (int)SPH_GRADIENT_SHEPARD_FULL)

/* The mean of two mobilities. */
typedef enum sph_mobility_mean {
    SPH_MOBILITY_ARITHMETIC, /* (m_i + m_j) / 2: as published */
    SPH_MOBILITY_HARMONIC,   /* 2 m_i m_j / (m_i + m_j): keeps the flux through a jump of m */
    SPH_MOBILITY_UPWIND      /* m of the particle with the higher potential; m_i if they are equal */
} sph_mobility_mean;

/* nu = sum_j V_j W_ij of a particle, and grad nu = sum_j V_j grad_i W_ij. */
typedef struct sph_shepard {
    sph_real nu;
    sph_vec gradient;
} sph_shepard;

/* A gradient of the kernel, g = radial e + rest. */
typedef struct sph_kernel_gradient {
    sph_real radial;
    sph_vec rest; /* 0, except for SPH_GRADIENT_FULL */
} sph_kernel_gradient;

/* g of a pair, for one of sph_elliptic_gradient. v: W and F of the pair; s: nu and grad nu of the target.
   V_j is read for SPH_GRADIENT_SHEPARD_FULL only, s for all but SPH_GRADIENT_DIFFUSE, s.gradient for
   SPH_GRADIENT_FULL only. Needs one of the four gradients, and s.nu not 0 where it is read. */
SPH_FN sph_kernel_gradient sph_elliptic_gradient_pair(int gradient, sph_wf v, sph_real V_j, sph_shepard s)
{
    sph_kernel_gradient g;
    SPH_ASSERT(SPHI_IS_GRADIENT(gradient) && (gradient == (int)SPH_GRADIENT_DIFFUSE || s.nu != SPH_R(0)));
    g.radial = -v.f;
    g.rest.x = g.rest.y = g.rest.z = SPH_R(0);
    if (gradient == (int)SPH_GRADIENT_FULL) {
        g.radial /= s.nu;
        g.rest = sph_scale(-v.w / (s.nu * s.nu), s.gradient);
    } else if (gradient == (int)SPH_GRADIENT_SHEPARD_DIFFUSE) g.radial /= s.nu;
    else if (gradient == (int)SPH_GRADIENT_SHEPARD_FULL) g.radial *= (SPH_R(1) - v.w * V_j / s.nu) / s.nu;
    return g;
}
/* g = W e, which takes the place of a gradient in the scheme of Basic, Degiuli & Ban. w is W of the pair. */
SPH_FN sph_kernel_gradient sph_elliptic_gradient_pair_basic_degiuli_ban(sph_real w)
{
    sph_kernel_gradient g;
    g.radial = w;
    g.rest.x = g.rest.y = g.rest.z = SPH_R(0);
    return g;
}
/* g as a vector. */
SPH_FN sph_vec sph_elliptic_gradient_vector(int dim, int gradient, sph_vec e, sph_kernel_gradient g)
{
    sph_vec v = sph_scale(g.radial, e);
    SPH_ASSERT(SPHI_IS_DIM(dim) && SPHI_IS_GRADIENT(gradient));
    if (gradient == (int)SPH_GRADIENT_FULL) {
        v.x += g.rest.x;
        if (dim > 1) v.y += g.rest.y;
        if (dim > 2) v.z += g.rest.z;
    }
    return v;
}
/* t = e . g / |e|^2. For coincident particles it is the radial part alone. */
SPH_FN sph_real sph_elliptic_projection(int dim, int gradient, sph_vec e, sph_kernel_gradient g)
{
    SPH_ASSERT(SPHI_IS_DIM(dim) && SPHI_IS_GRADIENT(gradient));
    return gradient == (int)SPH_GRADIENT_FULL
               ? g.radial + sphi_over_q(sph_dot(dim, e, g.rest), sph_dot(dim, e, e))
               : g.radial;
}

/* mu_ij, which is twice the mean of the mobilities. upstream = potential_i - potential_j; it is read for
   SPH_MOBILITY_UPWIND only. Needs one of the three means, m_i >= 0 and m_j >= 0. */
SPH_FN sph_real sph_mobility_pair(int mean, sph_real m_i, sph_real m_j, sph_real upstream)
{
    SPH_ASSERT(mean >= 0 && mean <= (int)SPH_MOBILITY_UPWIND && m_i >= SPH_R(0) && m_j >= SPH_R(0));
    if (mean == (int)SPH_MOBILITY_HARMONIC) return SPH_R(4) * m_i * (m_j / (m_i + m_j + SPHI_TINY));
    if (mean == (int)SPH_MOBILITY_UPWIND) return SPH_R(2) * (upstream >= SPH_R(0) ? m_i : m_j);
    return m_i + m_j;
}

/* What corrects the weights of one particle: the number scale and the vector xi (1/length) of
   the formulas above. */
typedef struct sph_elliptic_correction {
    sph_real scale;
    sph_vec xi;
} sph_elliptic_correction;

/* T_ij / mu_ij = scale V_j (t - xi . g), the weight of (u_j - u_i) for mu = 1. For radial gradients it is
   scale V_j t (1 - xi . e). */
SPH_FN sph_real sph_elliptic_weight(int dim, int gradient, sph_vec e, sph_kernel_gradient g,
                                    sph_elliptic_correction c, sph_real V_j)
{
    const sph_real t = sph_elliptic_projection(dim, gradient, e, g);
    if (gradient != (int)SPH_GRADIENT_FULL) return c.scale * V_j * t * (SPH_R(1) - sph_dot(dim, c.xi, e));
    return c.scale * V_j * (t - sph_dot(dim, c.xi, sph_elliptic_gradient_vector(dim, gradient, e, g)));
}

/* The moments of a particle: Gamma, N, N~ and the rows of K, kx = sum V_j e_x g and so on. Gamma and K are
   pure numbers; N and N~ have the unit 1/length. */
typedef struct sph_elliptic_moments {
    sph_sym gamma;
    sph_vec n, n_tilde, kx, ky, kz;
} sph_elliptic_moments;

/* The moments of a radial gradient from gamma and n, its Gamma and N, because K = Gamma and N~ = N. */
SPH_FN sph_elliptic_moments sph_elliptic_moments_radial(sph_sym gamma, sph_vec n)
{
    sph_elliptic_moments m;
    m.gamma = gamma;
    m.n = m.n_tilde = n;
    m.kx.x = gamma.xx;
    m.kx.y = m.ky.x = gamma.xy;
    m.kx.z = m.kz.x = gamma.xz;
    m.ky.y = gamma.yy;
    m.ky.z = m.kz.y = gamma.yz;
    m.kz.z = gamma.zz;
    return m;
}

/* *a = K^-1. Returns SPH_OK, or SPH_SINGULAR and then writes nothing. *conditioning, if the pointer
   is not null, is the smallest pivot: of K scaled to a unit diagonal, in [0, 1]; or for
   SPH_GRADIENT_FULL of K as it is. */
SPH_FN int sph_elliptic_invert(int dim, int gradient, const sph_elliptic_moments *m, sph_mat *a,
                               sph_real *conditioning)
{
    SPH_ASSERT(SPHI_IS_DIM(dim) && SPHI_IS_GRADIENT(gradient));
    if (gradient == (int)SPH_GRADIENT_FULL) {
        /* K is not symmetric. Its entries are of order one, because g is normalised by nu. */
        sphi_lu s;
        sph_real b[3][SPHI_MAX];
        int c, r;
        s.a[0][0] = m->kx.x;
        if (dim > 1) s.a[0][1] = m->kx.y, s.a[1][0] = m->ky.x, s.a[1][1] = m->ky.y;
        if (dim > 2)
            s.a[0][2] = m->kx.z, s.a[1][2] = m->ky.z, s.a[2][0] = m->kz.x, s.a[2][1] = m->kz.y,
            s.a[2][2] = m->kz.z;
        sphi_lu_factor(dim, &s);
        if (!(s.pivot_min > SPHI_PIVOT_MIN)) return SPH_SINGULAR;
        for (c = 0; c < 3; c++) {
            for (r = 0; r < 3; r++) b[c][r] = r == c ? SPH_R(1) : SPH_R(0);
            if (c < dim) sphi_lu_solve(dim, &s, b[c]);
        }
        a->x.x = b[0][0], a->x.y = b[1][0], a->x.z = b[2][0];
        a->y.x = b[0][1], a->y.y = b[1][1], a->y.z = b[2][1];
        a->z.x = b[0][2], a->z.y = b[1][2], a->z.z = b[2][2];
        if (conditioning) *conditioning = s.pivot_min;
    } else {
        sph_sym s;
        const int state = sph_solve_gradient(dim, m->gamma, &s, conditioning);
        if (state) return state;
        *a = sph_mat_of_sym(dim, s);
    }
    return SPH_OK;
}

/* The eigenvalues of a symmetric tensor in ascending order, by Jacobi's rotations. Those beyond dim are 0.
   Errors are rounding errors of the largest. */
SPH_FN sph_vec sph_sym_eigenvalues(int dim, sph_sym s)
{
    sph_real a[3][3], t;
    sph_vec v;
    int sweep, p, q, r;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    a[0][0] = s.xx;
    a[1][1] = dim > 1 ? s.yy : SPH_R(0);
    a[2][2] = dim > 2 ? s.zz : SPH_R(0);
    a[0][1] = a[1][0] = dim > 1 ? s.xy : SPH_R(0);
    a[0][2] = a[2][0] = dim > 2 ? s.xz : SPH_R(0);
    a[1][2] = a[2][1] = dim > 2 ? s.yz : SPH_R(0);
    for (sweep = 0; sweep < (dim > 2 ? 12 : 1); sweep++)
        for (p = 0; p < dim - 1; p++)
            for (q = p + 1; q < dim; q++) {
                sph_real theta, tangent, cosine, sine;
                if (!(SPHI_ABS(a[p][q]) > SPHI_TINY)) continue;
                theta = (a[q][q] - a[p][p]) / (SPH_R(2) * a[p][q]);
                tangent =
                    SPHI_COPYSIGN(SPH_R(1), theta) / (SPHI_ABS(theta) + SPHI_SQRT(theta * theta + SPH_R(1)));
                cosine = SPH_R(1) / SPHI_SQRT(tangent * tangent + SPH_R(1));
                sine = tangent * cosine;
                r = 3 - p - q; /* the axis that does not turn */
                a[p][p] -= tangent * a[p][q];
                a[q][q] += tangent * a[p][q];
                a[p][q] = a[q][p] = SPH_R(0);
                t = a[r][p];
                a[r][p] = a[p][r] = cosine * t - sine * a[r][q];
                a[r][q] = a[q][r] = sine * t + cosine * a[r][q];
            }
    for (p = 0; p < dim - 1; p++)
        for (q = p + 1; q < dim; q++)
            if (a[q][q] < a[p][p]) {
                t = a[p][p];
                a[p][p] = a[q][q];
                a[q][q] = t;
            }
    v.x = a[0][0];
    v.y = a[1][1];
    v.z = a[2][2];
    return v;
}

/* -------- elliptic operator: sweeps */

/* Options of the elliptic sweeps. All zeros are the defaults: gradient (15), arithmetic means, Gamma. */
typedef struct sph_elliptic_options {
    int gradient; /* an sph_elliptic_gradient */
    int mean;     /* an sph_mobility_mean */
    /* For M-SPH only. 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK. */
    int gamma_star;
    /* For Schwaiger and M-SPH. 1: scale = dim / tr Gamma* where tr Gamma* is large enough, else
       SPH_FELL_BACK. It takes the place of gamma_star. See the sweeps below. */
    int trace;
    /* Particles with a lower conditioning are SPH_ILL_CONDITIONED, but they are computed. */
    sph_real conditioning_min;
    sph_scalars potential; /* read for SPH_MOBILITY_UPWIND only */
    /* of the targets; is added to the result, if it is there; rows do not contain it */
    sph_scalars source;
} sph_elliptic_options;

/* Gamma* counts as definite if its smallest eigenvalue is at least this fraction of that of Gamma; for
   options.trace the two traces are compared. At boundaries Gamma* is often indefinite, or nearly singular,
   and the trace of its inverse would be huge. */
#define SPHI_GAMMA_STAR_MIN SPH_R(0.1)

/* h_ij = (h_i + h_j) / 2. If all particles have the same h, no h_j is read. */
SPH_FN sph_real sphi_mean_h(int uniform, sph_scalars h, sph_real h_i, sph_index j)
{
    return uniform ? h_i : SPH_R(0.5) * (h_i + sphi_at(h, j));
}

/* What the loops over the neighbours of one particle have in common. uniform: 1 if all particles
   have the same h. weight_only: 1 if g = W e takes the place of the gradient. */
typedef struct sphi_elliptic {
    sph_cloud cloud;
    sph_scalars m;
    sph_elliptic_options options;
    int uniform, weight_only;
} sphi_elliptic;

/* n: of how many particles the mobility is read */
SPH_FN int sphi_elliptic_check(sph_kernel k, int dim, const sphi_elliptic *a, sph_index n)
{
    const sph_elliptic_options o = a->options;
    int error = sphi_check_sweep(k, dim, a->cloud, "volume", a->cloud.volume);
    if (!error && (o.gradient < 0 || o.gradient > (int)SPH_GRADIENT_SHEPARD_FULL))
        error = sphi_refuse("options.gradient", -1, SPH_ERROR_VALUE);
    if (!error && (o.mean < 0 || o.mean > (int)SPH_MOBILITY_UPWIND))
        error = sphi_refuse("options.mean", -1, SPH_ERROR_VALUE);
    if (!error && !sphi_finite(o.conditioning_min))
        error = sphi_refuse("options.conditioning_min", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_not_negative("m", a->m, n);
    if (!error && o.mean == (int)SPH_MOBILITY_UPWIND)
        error = sphi_check_field("options.potential", o.potential, a->cloud.points.n);
    return error;
}

/* nu and its gradient. For the gradient (15) they are not needed, and are 1 and 0. */
SPH_FN sph_shepard sphi_elliptic_shepard(sph_kernel k, int dim, const sphi_elliptic *a, sph_index i)
{
    const sph_vec x_i = sphi_point(dim, a->cloud.points, i);
    const sph_real h_i = sphi_at(a->cloud.h, i);
    sph_real nu = sphi_at(a->cloud.volume, i) * sph_kernel_w(k, dim, SPH_R(0), h_i), sx = SPH_R(0),
             sy = SPH_R(0), sz = SPH_R(0);
    sph_shepard s;
    sph_index p;
    if (a->options.gradient == (int)SPH_GRADIENT_DIFFUSE) nu = SPH_R(1);
    else {
        SPH_SUM(p, a->cloud.list.start[i], a->cloud.list.start[i + 1], nu, sx, sy, sz) {
            const sph_index j = a->cloud.list.index[p];
            const sph_vec e = sphi_separation(dim, a->cloud.points, sphi_point(dim, a->cloud.points, j), x_i);
            const sph_wf v =
                sph_kernel_wf(k, dim, sph_length(dim, e), sphi_mean_h(a->uniform, a->cloud.h, h_i, j));
            const sph_real V_j = sphi_at(a->cloud.volume, j);
            nu += V_j * v.w;
            sx -= V_j * v.f * e.x;
            if (dim > 1) sy -= V_j * v.f * e.y;
            if (dim > 2) sz -= V_j * v.f * e.z;
        }
    }
    s.nu = nu != SPH_R(0) ? nu : SPH_R(1); /* 0: nobody is there, so that nothing is divided by it */
    s.gradient.x = sx;
    s.gradient.y = sy;
    s.gradient.z = sz;
    return s;
}

/* A pair i, j of the list. */
typedef struct sphi_elliptic_pair {
    sph_vec e;
    sph_kernel_gradient g;
    sph_real V_j;
} sphi_elliptic_pair;
SPH_FN sphi_elliptic_pair sphi_elliptic_pair_of(sph_kernel k, int dim, const sphi_elliptic *a, sph_shepard s,
                                                sph_vec x_i, sph_real h_i, sph_index j)
{
    sphi_elliptic_pair c;
    c.e = sphi_separation(dim, a->cloud.points, sphi_point(dim, a->cloud.points, j), x_i);
    c.V_j = sphi_at(a->cloud.volume, j);
    if (a->weight_only)
        c.g = sph_elliptic_gradient_pair_basic_degiuli_ban(
            sph_kernel_w(k, dim, sph_length(dim, c.e), sphi_mean_h(a->uniform, a->cloud.h, h_i, j)));
    else
        c.g = sph_elliptic_gradient_pair(
            a->options.gradient,
            sph_kernel_wf(k, dim, sph_length(dim, c.e), sphi_mean_h(a->uniform, a->cloud.h, h_i, j)), c.V_j,
            s);
    return c;
}

SPH_FN sph_elliptic_moments sphi_elliptic_moments_of(sph_kernel k, int dim, const sphi_elliptic *a,
                                                     sph_shepard s, sph_index i)
{
    const sph_vec x_i = sphi_point(dim, a->cloud.points, i);
    const sph_real h_i = sphi_at(a->cloud.h, i);
    const int gradient = a->options.gradient;
    sph_real xx = SPH_R(0), xy = SPH_R(0), yy = SPH_R(0), xz = SPH_R(0), yz = SPH_R(0), zz = SPH_R(0),
             nx = SPH_R(0), ny = SPH_R(0), nz = SPH_R(0);
    sph_elliptic_moments m;
    sph_sym gamma;
    sph_vec n;
    sph_index p;
    SPH_SUM(p, a->cloud.list.start[i], a->cloud.list.start[i + 1], xx, xy, yy, xz, yz, zz, nx, ny, nz) {
        const sphi_elliptic_pair c = sphi_elliptic_pair_of(k, dim, a, s, x_i, h_i, a->cloud.list.index[p]);
        const sph_vec te = sph_scale(c.V_j * sph_elliptic_projection(dim, gradient, c.e, c.g), c.e);
        xx += te.x * c.e.x;
        nx += te.x;
        if (dim > 1) {
            xy += te.x * c.e.y;
            yy += te.y * c.e.y;
            ny += te.y;
        }
        if (dim > 2) {
            xz += te.x * c.e.z;
            yz += te.y * c.e.z;
            zz += te.z * c.e.z;
            nz += te.z;
        }
    }
    gamma.xx = xx;
    gamma.xy = xy;
    gamma.yy = yy;
    gamma.xz = xz;
    gamma.yz = yz;
    gamma.zz = zz;
    n.x = nx;
    n.y = ny;
    n.z = nz;
    m = sph_elliptic_moments_radial(gamma, n);
    if (gradient == (int)SPH_GRADIENT_FULL) { /* K and N differ from Gamma and N~ */
        const sph_real own =
            -sphi_at(a->cloud.volume, i) * sph_kernel_w(k, dim, SPH_R(0), h_i) / (s.nu * s.nu);
        sph_real k0 = SPH_R(0), k1 = SPH_R(0), k2 = SPH_R(0), k3 = SPH_R(0), k4 = SPH_R(0), k5 = SPH_R(0),
                 k6 = SPH_R(0), k7 = SPH_R(0), k8 = SPH_R(0);
        nx = own * s.gradient.x; /* The particle itself counts in N only. With it, N is 0. */
        ny = own * s.gradient.y;
        nz = own * s.gradient.z;
        SPH_SUM(p, a->cloud.list.start[i], a->cloud.list.start[i + 1], k0, k1, k2, k3, k4, k5, k6, k7, k8, nx,
                ny, nz) {
            const sphi_elliptic_pair c =
                sphi_elliptic_pair_of(k, dim, a, s, x_i, h_i, a->cloud.list.index[p]);
            const sph_vec g = sph_scale(c.V_j, sph_elliptic_gradient_vector(dim, gradient, c.e, c.g));
            k0 += c.e.x * g.x;
            nx += g.x;
            if (dim > 1) {
                k1 += c.e.x * g.y;
                k3 += c.e.y * g.x;
                k4 += c.e.y * g.y;
                ny += g.y;
            }
            if (dim > 2) {
                k2 += c.e.x * g.z;
                k5 += c.e.y * g.z;
                k6 += c.e.z * g.x;
                k7 += c.e.z * g.y;
                k8 += c.e.z * g.z;
                nz += g.z;
            }
        }
        m.kx.x = k0, m.kx.y = k1, m.kx.z = k2;
        m.ky.x = k3, m.ky.y = k4, m.ky.z = k5;
        m.kz.x = k6, m.kz.y = k7, m.kz.z = k8;
        m.n.x = nx, m.n.y = ny, m.n.z = nz;
    }
    return m;
}

/* Gamma* = Gamma - sum V_j (xi . g) e e^T, (71). */
SPH_FN sph_sym sphi_elliptic_gamma_star(sph_kernel k, int dim, const sphi_elliptic *a, sph_shepard s,
                                        sph_index i, sph_sym gamma, sph_vec xi)
{
    const sph_vec x_i = sphi_point(dim, a->cloud.points, i);
    const sph_real h_i = sphi_at(a->cloud.h, i);
    sph_index p;
    for (p = a->cloud.list.start[i]; p < a->cloud.list.start[i + 1]; p++) {
        const sphi_elliptic_pair c = sphi_elliptic_pair_of(k, dim, a, s, x_i, h_i, a->cloud.list.index[p]);
        const sph_vec we = sph_scale(
            c.V_j * sph_dot(dim, xi, sph_elliptic_gradient_vector(dim, a->options.gradient, c.e, c.g)), c.e);
        gamma.xx -= we.x * c.e.x;
        if (dim > 1) gamma.xy -= we.x * c.e.y, gamma.yy -= we.y * c.e.y;
        if (dim > 2) gamma.xz -= we.x * c.e.z, gamma.yz -= we.y * c.e.z, gamma.zz -= we.z * c.e.z;
    }
    return gamma;
}

enum {
    SPHI_ELLIPTIC_BROOKSHAW,
    SPHI_ELLIPTIC_CORRECTED,
    SPHI_ELLIPTIC_SCHWAIGER,
    SPHI_ELLIPTIC_MSPH,
    SPHI_ELLIPTIC_BASIC
};

/* scale, xi and conditioning of a particle. With SPH_TOO_FEW and SPH_SINGULAR scale and xi are 0. Its
   moments are written, too, except for Brookshaw's scheme, which has none. */
SPH_FN int sphi_elliptic_correct(int scheme, sph_kernel k, int dim, const sphi_elliptic *a, sph_shepard s,
                                 sph_index i, sph_elliptic_correction *c, sph_elliptic_moments *m,
                                 sph_real *conditioning)
{
    sph_mat inverse;
    sph_sym gamma_inverse, gamma_star;
    sph_real trace;
    int state = SPH_OK;
    c->scale = c->xi.x = c->xi.y = c->xi.z = SPH_R(0);
    *conditioning = SPH_R(1);
    if (scheme == SPHI_ELLIPTIC_BROOKSHAW) {
        c->scale = SPH_R(1);
        return SPH_OK;
    }
    *conditioning = SPH_R(0);
    *m = sphi_elliptic_moments_of(k, dim, a, s, i);
    if (sph_elliptic_invert(dim, a->options.gradient, m, &inverse, conditioning))
        return sphi_singular_status(k, dim, i, a->cloud.points, a->cloud.list, sphi_at(a->cloud.h, i), dim);
    trace = inverse.x.x + (dim > 1 ? inverse.y.y : SPH_R(0)) + (dim > 2 ? inverse.z.z : SPH_R(0));
    if (scheme != SPHI_ELLIPTIC_CORRECTED) {
        c->xi = sph_mat_times(dim, inverse, scheme == SPHI_ELLIPTIC_SCHWAIGER ? m->n : m->n_tilde);
        if (a->options.gradient == (int)SPH_GRADIENT_FULL) {
            if (sph_solve_gradient(dim, m->gamma, &gamma_inverse, conditioning)) {
                c->xi = sph_scale(SPH_R(0), c->xi);
                return SPH_SINGULAR;
            }
            trace = sphi_trace(dim, gamma_inverse);
        }
        if (a->options.trace) {
            const sph_real full = sphi_trace(dim, m->gamma),
                           left = sphi_trace(dim, sphi_elliptic_gamma_star(k, dim, a, s, i, m->gamma, c->xi));
            if (left >= SPHI_GAMMA_STAR_MIN * full) trace = SPH_R(dim * dim) / left;
            else state = SPH_FELL_BACK;
        } else if (scheme == SPHI_ELLIPTIC_MSPH && a->options.gamma_star) {
            gamma_star = sphi_elliptic_gamma_star(k, dim, a, s, i, m->gamma, c->xi);
            if (sph_sym_eigenvalues(dim, gamma_star).x >=
                    SPHI_GAMMA_STAR_MIN * sph_sym_eigenvalues(dim, m->gamma).x &&
                sph_solve_gradient(dim, gamma_star, &gamma_inverse, 0) == SPH_OK)
                trace = sphi_trace(dim, gamma_inverse);
            else state = SPH_FELL_BACK;
        }
    }
    c->scale = trace / SPH_R(dim);
    if (*conditioning < a->options.conditioning_min) state = SPH_ILL_CONDITIONED;
    return state;
}

SPH_FN sph_real sphi_elliptic_mobility(const sphi_elliptic *a, sph_real m_i, sph_real potential_i,
                                       sph_index j)
{
    const int upwind = a->options.mean == (int)SPH_MOBILITY_UPWIND;
    return sph_mobility_pair(a->options.mean, m_i, sphi_at(a->m, j),
                             upwind ? potential_i - sphi_at(a->options.potential, j) : SPH_R(0));
}
SPH_FN sph_real sphi_elliptic_potential(const sphi_elliptic *a, sph_index i)
{
    return a->options.mean == (int)SPH_MOBILITY_UPWIND ? sphi_at(a->options.potential, i) : SPH_R(0);
}

SPH_FN sph_index sphi_elliptic_apply(int scheme, sph_kernel k, int dim, const sphi_elliptic *a, sph_scalars u,
                                     sph_scalar_out out)
{
    sph_index i, p, failed = 0;
    for (i = a->cloud.first; i < a->cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, a->cloud.points, i);
        const sph_real h_i = sphi_at(a->cloud.h, i), m_i = sphi_at(a->m, i), u_i = sphi_at(u, i),
                       potential_i = sphi_elliptic_potential(a, i);
        const sph_shepard s = sphi_elliptic_shepard(k, dim, a, i);
        sph_elliptic_correction correction;
        sph_elliptic_moments moments;
        sph_real conditioning, sum = SPH_R(0);
        int state = sphi_elliptic_correct(scheme, k, dim, a, s, i, &correction, &moments, &conditioning);
        SPH_SUM(p, a->cloud.list.start[i], a->cloud.list.start[i + 1], sum) {
            const sph_index j = a->cloud.list.index[p];
            const sphi_elliptic_pair c = sphi_elliptic_pair_of(k, dim, a, s, x_i, h_i, j);
            sum += sph_elliptic_weight(dim, a->options.gradient, c.e, c.g, correction, c.V_j) *
                   sphi_elliptic_mobility(a, m_i, potential_i, j) * (sphi_at(u, j) - u_i);
        }
        if (a->options.source.p) sum += sphi_at(a->options.source, i);
        if (!sphi_finite(sum)) state = SPH_NOT_FINITE;
        failed += sphi_answer(out, i, sphi_unanswered(state) ? SPH_R(0) : sum, state);
    }
    return failed;
}
SPH_FN sph_index sphi_elliptic_row(int scheme, sph_kernel k, int dim, const sphi_elliptic *a,
                                   sph_rows_out out)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT row = out.row;
    sph_index i, p, failed = 0;
    for (i = a->cloud.first; i < a->cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, a->cloud.points, i);
        const sph_real h_i = sphi_at(a->cloud.h, i), m_i = sphi_at(a->m, i),
                       potential_i = sphi_elliptic_potential(a, i);
        const sph_shepard s = sphi_elliptic_shepard(k, dim, a, i);
        sph_elliptic_correction correction;
        sph_elliptic_moments moments;
        sph_real conditioning;
        int state = sphi_elliptic_correct(scheme, k, dim, a, s, i, &correction, &moments, &conditioning);
        SPH_EACH(p, a->cloud.list.start[i], a->cloud.list.start[i + 1]) {
            const sph_index j = a->cloud.list.index[p];
            const sphi_elliptic_pair c = sphi_elliptic_pair_of(k, dim, a, s, x_i, h_i, j);
            row[p] = sph_elliptic_weight(dim, a->options.gradient, c.e, c.g, correction, c.V_j) *
                     sphi_elliptic_mobility(a, m_i, potential_i, j);
        }
        if (sphi_row_finite(row, a->cloud.list.start[i], a->cloud.list.start[i + 1])) state = SPH_NOT_FINITE;
        sphi_row_answer(out, a->cloud.list, i, 1, conditioning, state);
        failed += state != SPH_OK;
    }
    return failed;
}
SPH_FN sphi_elliptic sphi_elliptic_of(sph_cloud cloud, sph_scalars m, sph_elliptic_options options,
                                      int uniform)
{
    sphi_elliptic a;
    a.cloud = cloud;
    a.m = m;
    a.options = options;
    a.uniform = uniform;
    a.weight_only = 0;
    return a;
}
/* The same for a scheme. */
SPH_FN sphi_elliptic sphi_elliptic_scheme(int scheme, sph_cloud cloud, sph_scalars m,
                                          sph_elliptic_options options, int uniform)
{
    sphi_elliptic a = sphi_elliptic_of(cloud, m, options, uniform);
    if (scheme == SPHI_ELLIPTIC_BASIC) {
        a.options.gradient = (int)SPH_GRADIENT_DIFFUSE; /* radial, without nu */
        a.options.trace = a.weight_only = 1;
    }
    return a;
}
/* The two kinds of sweeps: to a result, or to rows. Each loop is compiled twice: once for one h, and once
   for an h of each particle. */
SPH_FN sph_index sphi_elliptic_sweep(int scheme, sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                     sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    const sphi_elliptic one = sphi_elliptic_scheme(scheme, cloud, m, options, 1),
                        own = sphi_elliptic_scheme(scheme, cloud, m, options, 0);
    int error = sphi_elliptic_check(k, dim, &own, cloud.points.n);
    if (!error) error = sphi_check_field("u", u, cloud.points.n);
    if (!error && options.source.p) error = sphi_check_field("options.source", options.source, cloud.last);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_elliptic_apply(scheme, k, dim, &own, u, out)
                          : sphi_elliptic_apply(scheme, k, dim, &one, u, out);
}
SPH_FN sph_index sphi_elliptic_rows(int scheme, sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                    sph_elliptic_options options, sph_rows_out out)
{
    const sphi_elliptic one = sphi_elliptic_scheme(scheme, cloud, m, options, 1),
                        own = sphi_elliptic_scheme(scheme, cloud, m, options, 0);
    int error = sphi_elliptic_check(k, dim, &own, cloud.points.n);
    if (!error && !out.row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_elliptic_row(scheme, k, dim, &own, out)
                          : sphi_elliptic_row(scheme, k, dim, &one, out);
}

/* div(m grad u)_i + source_i by the five schemes. The chapter's opening has formulas,
   sources and exactness.
     h        one for all particles, or one for each. A pair uses (h_i + h_j) / 2, so that the list must
              hold every j with r < support ratio * (h_i + h_j) / 2 (SPH_MEAN).
     m        the mobility, not negative.
     options  all zeros are the defaults. options.source = sph_scalars_none() adds no source.
     rows     div(m grad u)_i = diagonal[i] u_i + sum_p row[p] u_j, p along the list; factor[i] = 1. For a
              vector unknown compute the rows once, and call sph_rows_apply for each component.
     trace    In disorder tr Gamma^-1 / dim is not the right factor, because tr Gamma tr Gamma^-1 >= dim^2.
              On jittered clouds the rows of Schwaiger's scheme and M-SPH are 0.3 to 0.7 % too large, at
              any resolution, and solutions with a source do not converge. With options.trace = 1 the
              factor is dim / tr Gamma*. Then sum_j T_ij |e|^2 = 2 dim m where m is constant: the result is
              exact for |x|^2 at any particle. Signs do not change, because the weights of a row keep their
              ratios. This factor is an addition of this toolkit; examples/papers/elliptic_clouds.c has the
              orders of convergence. At most boundary particles it is not available, because tr Gamma* is
              small or negative there.
   Returns the number of targets that are not SPH_OK, or a negative sph_error. The states are:
     SPH_TOO_FEW, SPH_SINGULAR  the neighbours are too few, or lie on a line or in a plane; result and row
                                are 0. Brookshaw's scheme does not have these states.
     SPH_FELL_BACK              computed with Gamma, because Gamma* is not definite (or its
                                trace is too small).
     SPH_ILL_CONDITIONED        computed, but the conditioning is below conditioning_min. It is the
                                smallest pivot of the scaled Gamma (1 good, 0 singular).
   Coincident neighbours have the radial weight of r = 0.
   Atlas: div(m grad u) exact for constants, inside lattices for linear fields; order 0 inside lattices, -1
   in disorder, -1 at boundaries. */
SPH_FN sph_index sph_elliptic_brookshaw(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                        sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_BROOKSHAW, k, dim, cloud, m, options, u, out);
}
/* The same by (51): Brookshaw's scheme times tr K^-1 / dim.
   Atlas: div(m grad u) exact for constants, inside lattices for cubic fields; order 2 inside lattices, -1
   in disorder, -1 at boundaries. */
SPH_FN sph_index sph_elliptic_brookshaw_corrected(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                                  sph_elliptic_options options, sph_scalars u,
                                                  sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_CORRECTED, k, dim, cloud, m, options, u, out);
}
/* The same by (52), Schwaiger's scheme: exact for linear u where m is constant.
   Atlas: div(m grad u) exact for linear fields, inside lattices for cubic fields; order 2 inside lattices,
   0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_elliptic_schwaiger(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                        sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_SCHWAIGER, k, dim, cloud, m, options, u, out);
}
/* The same by (69), M-SPH: for radial gradients the same numbers as Schwaiger's scheme.
   Atlas: div(m grad u) exact for linear fields, inside lattices for cubic fields; order 2 inside lattices,
   0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_elliptic_msph(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                   sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_MSPH, k, dim, cloud, m, options, u, out);
}
/* The same by Basic, Degiuli & Ban 2018, JCP 354, 269: exact for linear u and for |x|^2 where m is constant,
   and for no other quadratic field at a boundary. It needs no derivative of the kernel. options.gradient,
   gamma_star and trace are not read: the scale is always dim / tr Gamma*. Where tr Gamma* is below a tenth of
   tr Gamma, as at one-sided particles, their denominator is small or negative; the scale is then
   tr Gamma^-1 / dim, and the particle is SPH_FELL_BACK.
   Atlas: div(m grad u) exact for linear fields, inside lattices for cubic fields; order 2 inside lattices,
   0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_elliptic_basic_degiuli_ban(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                                sph_elliptic_options options, sph_scalars u,
                                                sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_BASIC, k, dim, cloud, m, options, u, out);
}
/* The rows of sph_elliptic_brookshaw (meshless transmissibilities), without its source. */
SPH_FN sph_index sph_elliptic_rows_brookshaw(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                             sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_BROOKSHAW, k, dim, cloud, m, options, out);
}
/* The rows of sph_elliptic_brookshaw_corrected. */
SPH_FN sph_index sph_elliptic_rows_brookshaw_corrected(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                                       sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_CORRECTED, k, dim, cloud, m, options, out);
}
/* The rows of sph_elliptic_schwaiger. */
SPH_FN sph_index sph_elliptic_rows_schwaiger(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                             sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_SCHWAIGER, k, dim, cloud, m, options, out);
}
/* The rows of sph_elliptic_msph. */
SPH_FN sph_index sph_elliptic_rows_msph(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                        sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_MSPH, k, dim, cloud, m, options, out);
}

/* The rows of sph_elliptic_basic_degiuli_ban. */
SPH_FN sph_index sph_elliptic_rows_basic_degiuli_ban(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                                     sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_BASIC, k, dim, cloud, m, options, out);
}

/* What the neighbourhood of a particle promises for M-SPH with the gradient of the options. Each array has
   one number a particle; null pointers are not written. */
typedef struct sph_elliptic_report {
    /* The least and the largest T_ij / (scale V_j mu t_ij) = 1 - xi . e of the neighbours inside the support.
       (92): if both have the same sign, all weights have one sign. (93): if both are positive, so are all
       weights of the row. */
    SPH_GLOBAL sph_real *sign_least, *sign_most;
    SPH_GLOBAL sph_real *xi; /* |xi| = |N~ C|, figure 6 of the paper; unit 1/length */
    /* The largest V_j e . g / dim. The SPH continuity condition (21) asks for at most 1. */
    SPH_GLOBAL sph_real *continuity;
    SPH_GLOBAL sph_real *n, *n_bound; /* |N| and its bound sum V_j |g|, (22), which is a constant / h */
    /* The smallest eigenvalue of K = C^-1 (of its symmetric part). It is near 1 in the interior, and smaller
       towards a free surface: Marrone et al. 2010, JCP 229, 3652, with gradient (17). */
    SPH_GLOBAL sph_real *eigenvalue_least;
    SPH_GLOBAL sph_real *eigenvalue_ratio; /* of Gamma: largest / smallest; 0 if the smallest is <= 0 */
    size_t stride;                         /* of all arrays but status, in sph_real; 0 counts as 1 */
    SPH_GLOBAL unsigned char *status;      /* contiguous; as for sph_elliptic_msph with the same options */
} sph_elliptic_report;

/* Fills an sph_elliptic_report for each target. Lists as for the elliptic sweeps; mobilities do not
   matter. Where the status is SPH_TOO_FEW or SPH_SINGULAR, sign_least, sign_most and xi are 0; the other
   numbers are computed. Returns the number of targets that are not SPH_OK, or a negative sph_error. */
SPH_FN sph_index sph_elliptic_diagnose(sph_kernel k, int dim, sph_cloud cloud, sph_elliptic_options options,
                                       sph_elliptic_report out)
{
    const sphi_elliptic a = sphi_elliptic_of(cloud, cloud.volume, options, cloud.h.stride == 0);
    const int gradient = options.gradient;
    const size_t stride = sphi_stride(out.stride);
    sph_index i, p, failed = 0;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error && (gradient < 0 || gradient > (int)SPH_GRADIENT_SHEPARD_FULL))
        error = sphi_refuse("options.gradient", -1, SPH_ERROR_VALUE);
    if (!error && !sphi_finite(options.conditioning_min))
        error = sphi_refuse("options.conditioning_min", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_shepard s = sphi_elliptic_shepard(k, dim, &a, i);
        sph_elliptic_moments m;
        sph_elliptic_correction correction;
        sph_real conditioning, least = SPH_R(0), most = SPH_R(0), continuity = SPH_R(0), bound = SPH_R(0),
                               ratio = SPH_R(0);
        sph_sym symmetric;
        sph_vec eigen;
        int lost = 0, any = 0,
            state =
                sphi_elliptic_correct(SPHI_ELLIPTIC_MSPH, k, dim, &a, s, i, &correction, &m, &conditioning);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sphi_elliptic_pair c = sphi_elliptic_pair_of(k, dim, &a, s, x_i, h_i, cloud.list.index[p]);
            const sph_vec g = sph_elliptic_gradient_vector(dim, gradient, c.e, c.g);
            const sph_real t = sph_elliptic_projection(dim, gradient, c.e, c.g);
            const sph_real sign =
                SPH_R(1) - (gradient == (int)SPH_GRADIENT_FULL ? sph_dot(dim, correction.xi, g) / t
                                                               : sph_dot(dim, correction.xi, c.e));
            if (c.V_j * sph_dot(dim, c.e, g) > continuity * SPH_R(dim))
                continuity = c.V_j * sph_dot(dim, c.e, g) / SPH_R(dim);
            bound += SPHI_ABS(c.V_j) * sph_length(dim, g);
            if (!(SPHI_ABS(t) > SPH_R(0))) continue; /* outside the support */
            if (!any || sign < least) least = sign;
            if (!any || sign > most) most = sign;
            any = 1;
        }
        symmetric.xx = m.kx.x;
        symmetric.xy = SPH_R(0.5) * (m.kx.y + m.ky.x);
        symmetric.yy = m.ky.y;
        symmetric.xz = SPH_R(0.5) * (m.kx.z + m.kz.x);
        symmetric.yz = SPH_R(0.5) * (m.ky.z + m.kz.y);
        symmetric.zz = m.kz.z;
        eigen = sph_sym_eigenvalues(dim, m.gamma);
        if (eigen.x > SPH_R(0)) ratio = (dim == 1 ? eigen.x : dim == 2 ? eigen.y : eigen.z) / eigen.x;
        lost |= sphi_put(out.sign_least, stride, i, sphi_unanswered(state) ? SPH_R(0) : least);
        lost |= sphi_put(out.sign_most, stride, i, sphi_unanswered(state) ? SPH_R(0) : most);
        lost |= sphi_put(out.xi, stride, i, sph_length(dim, correction.xi));
        lost |= sphi_put(out.continuity, stride, i, continuity);
        lost |= sphi_put(out.n, stride, i, sph_length(dim, m.n));
        lost |= sphi_put(out.n_bound, stride, i, bound);
        lost |= sphi_put(out.eigenvalue_least, stride, i, sph_sym_eigenvalues(dim, symmetric).x);
        lost |= sphi_put(out.eigenvalue_ratio, stride, i, ratio);
        if (lost) state = SPH_NOT_FINITE;
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* -------- elliptic operator: a mobility for each axis, div(M grad u) with M = diag(M_x, M_y, M_z) */

/* The mobilities of the axes. */
typedef struct sph_diagonal {
    sph_scalars x, y, z; /* y, z are not read below dim 2, 3 */
} sph_diagonal;

SPH_FN sph_vec sphi_diagonal_sum(int dim, sph_diagonal mobility, sph_index i, sph_index j)
{
    sph_vec v;
    v.x = sphi_at(mobility.x, i) + sphi_at(mobility.x, j);
    v.y = dim > 1 ? sphi_at(mobility.y, i) + sphi_at(mobility.y, j) : SPH_R(0);
    v.z = dim > 2 ? sphi_at(mobility.z, i) + sphi_at(mobility.z, j) : SPH_R(0);
    return v;
}

/* Rows of div(M grad u) for a diagonal M that are consistent on full supports. (69) is not, because of the
   fourth moment: sum_j V_j G e_a e_b sum_c M_c e_c^2 / |e|^2 with G = -F_ij is not M_a delta_ab. It is, if
   M is replaced by S = T^-1 M with T_ac = sum V_j G e_a^2 e_c^2 / |e|^2. The rows are
       row = V_j G sum_c S(M_i + M_j)_c (e_c^2 / |e|^2 - (K^-1 N_c) . e),
       N_c = sum V_j G e e_c^2 / |e|^2,   K = sum V_j G e e^T.
   In the continuum S = ((dim + 2) M - tr M) / 2. If all neighbours lie on the axes, T is diagonal and
   the rows are those of M-SPH; so they are for isotropic M where T is isotropic. This form is an
   addition of this toolkit.
   Exact for linear fields (M constant) at every particle, and for xx, yy, zz in the interior of lattices;
   elsewhere the error is O(disorder).
   Signs: S may be negative if M_x / M_y is beyond 3 (2D). Weights then have both signs, and maximum
   principles are lost.
   The gradient is (15), means are arithmetic, a pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). A row is
   0 where the state is SPH_TOO_FEW or SPH_SINGULAR: K or T is singular. T is so where neighbours lie in
   fewer directions than there are axes. Returns the number of targets that are not SPH_OK, or a
   negative sph_error.
   Atlas: div(m grad u) exact for linear fields, inside lattices for cubic fields; order 2 inside lattices,
   0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_elliptic_rows_anisotropic(sph_kernel k, int dim, sph_cloud cloud, sph_diagonal mobility,
                                               sph_rows_out out)
{
    const sph_elliptic_options options = {0, 0, 0, 0, SPH_R(0), {0, 0}, {0, 0}};
    const sphi_elliptic a = sphi_elliptic_of(cloud, mobility.x, options, cloud.h.stride == 0);
    sph_shepard none;
    sph_index i, p, failed = 0;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_not_negative("mobility.x", mobility.x, cloud.points.n);
    if (!error && dim > 1) error = sphi_check_not_negative("mobility.y", mobility.y, cloud.points.n);
    if (!error && dim > 2) error = sphi_check_not_negative("mobility.z", mobility.z, cloud.points.n);
    if (!error && !out.row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    none.nu = SPH_R(1);
    none.gradient.x = none.gradient.y = none.gradient.z = SPH_R(0);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_sym moment = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)}, second = moment,
                K_inverse = moment, T_inverse = moment;
        sph_vec nx = {SPH_R(0), SPH_R(0), SPH_R(0)}, ny = nx, nz = nx;
        sph_real conditioning = SPH_R(0), pivot = SPH_R(0);
        int state;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sphi_elliptic_pair c =
                sphi_elliptic_pair_of(k, dim, &a, none, x_i, h_i, cloud.list.index[p]);
            const sph_vec e = c.e, we = sph_scale(c.V_j * c.g.radial, e);
            const sph_real q = sphi_over_q(SPH_R(1), sph_dot(dim, e, e));
            const sph_vec wex = sph_scale(e.x * e.x * q, we), wey = sph_scale(e.y * e.y * q, we),
                          wez = sph_scale(e.z * e.z * q, we);
            moment.xx += we.x * e.x;
            second.xx += wex.x * e.x;
            nx.x += wex.x;
            if (dim > 1) {
                moment.xy += we.x * e.y;
                moment.yy += we.y * e.y;
                second.xy += wey.x * e.x;
                second.yy += wey.y * e.y;
                nx.y += wex.y;
                ny.x += wey.x;
                ny.y += wey.y;
            }
            if (dim > 2) {
                moment.xz += we.x * e.z;
                moment.yz += we.y * e.z;
                moment.zz += we.z * e.z;
                second.xz += wez.x * e.x;
                second.yz += wez.y * e.y;
                second.zz += wez.z * e.z;
                nx.z += wex.z;
                ny.z += wey.z;
                nz.x += wez.x;
                nz.y += wez.y;
                nz.z += wez.z;
            }
        }
        state = sph_solve_gradient(dim, moment, &K_inverse, &conditioning);
        if (!state) state = sph_solve_gradient(dim, second, &T_inverse, &pivot);
        if (state) state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i, dim);
        else if (pivot < conditioning) conditioning = pivot;
        nx = sphi_sym_times(dim, K_inverse, nx);
        ny = sphi_sym_times(dim, K_inverse, ny);
        nz = sphi_sym_times(dim, K_inverse, nz);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sphi_elliptic_pair c = sphi_elliptic_pair_of(k, dim, &a, none, x_i, h_i, j);
            const sph_vec along = sphi_sym_times(dim, T_inverse, sphi_diagonal_sum(dim, mobility, i, j));
            const sph_real q = sphi_over_q(SPH_R(1), sph_dot(dim, c.e, c.e));
            sph_real sum = along.x * (c.e.x * c.e.x * q - sph_dot(dim, nx, c.e));
            if (dim > 1) sum += along.y * (c.e.y * c.e.y * q - sph_dot(dim, ny, c.e));
            if (dim > 2) sum += along.z * (c.e.z * c.e.z * q - sph_dot(dim, nz, c.e));
            out.row[p] = state ? SPH_R(0) : c.V_j * c.g.radial * sum;
        }
        if (sphi_row_finite(out.row, cloud.list.start[i], cloud.list.start[i + 1])) state = SPH_NOT_FINITE;
        sphi_row_answer(out, cloud.list, i, 1, conditioning, state);
        failed += state != SPH_OK;
    }
    return failed;
}

/* -------- elliptic operator: a full tensor, div(M grad u) with any symmetric M */

/* The products of the components of e that quadratic forms consist of, xx, xy, yy, xz, yz, zz, and how many
   there are. */
SPH_FN int sphi_products(int dim, sph_vec e, sph_real *q)
{
    q[0] = e.x * e.x;
    if (dim > 1) q[1] = e.x * e.y, q[2] = e.y * e.y;
    if (dim > 2) q[3] = e.x * e.z, q[4] = e.y * e.z, q[5] = e.z * e.z;
    return dim * (dim + 1) / 2;
}
/* The components of the symmetric part of M_i + M_j, in the same order. */
SPH_FN void sphi_tensor_sum(int dim, sph_mat a, sph_mat b, sph_real *m)
{
    m[0] = a.x.x + b.x.x;
    if (dim > 1) m[1] = SPH_R(0.5) * (a.x.y + a.y.x + b.x.y + b.y.x), m[2] = a.y.y + b.y.y;
    if (dim > 2)
        m[3] = SPH_R(0.5) * (a.x.z + a.z.x + b.x.z + b.z.x),
        m[4] = SPH_R(0.5) * (a.y.z + a.z.y + b.y.z + b.z.y), m[5] = a.z.z + b.z.z;
}
/* What the rows of a particle are made of: T^-1, row by row, and the vectors K^-1 N_s. */
typedef struct sphi_tensor {
    sph_real inverse[SPHI_MAX * SPHI_MAX];
    sph_vec kn[SPHI_MAX];
} sphi_tensor;

/* The moments of particle i, and the system that they make. Returns SPH_OK, or the state and then the
   conditioning 0. */
SPH_FN int sphi_tensor_solve(sph_kernel k, int dim, const sphi_elliptic *a, sph_index i, sphi_tensor *t,
                             sph_real *conditioning)
{
    const sph_vec x_i = sphi_point(dim, a->cloud.points, i);
    const sph_real h_i = sphi_at(a->cloud.h, i);
    sph_sym moment = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)}, inverse = moment;
    sph_vec n[SPHI_MAX], third[SPHI_MAX];
    sph_real q[SPHI_MAX] = {SPH_R(0)}, pivot, size;
    sph_shepard none;
    sphi_lu lu;
    sph_index p;
    int r, s, many = 0;
    none.nu = SPH_R(1);
    none.gradient.x = none.gradient.y = none.gradient.z = SPH_R(0);
    *conditioning = SPH_R(0);
    for (s = 0; s < (int)SPHI_MAX; s++) {
        n[s].x = n[s].y = n[s].z = SPH_R(0);
        third[s] = t->kn[s] = n[s];
        for (r = 0; r < (int)SPHI_MAX; r++) lu.a[r][s] = SPH_R(0);
    }
    for (p = a->cloud.list.start[i]; p < a->cloud.list.start[i + 1]; p++) {
        const sphi_elliptic_pair c = sphi_elliptic_pair_of(k, dim, a, none, x_i, h_i, a->cloud.list.index[p]);
        const sph_vec we = sph_scale(c.V_j * c.g.radial, c.e);
        const sph_real per = sphi_over_q(SPH_R(1), sph_dot(dim, c.e, c.e));
        many = sphi_products(dim, c.e, q);
        moment.xx += we.x * c.e.x;
        if (dim > 1) moment.xy += we.x * c.e.y, moment.yy += we.y * c.e.y;
        if (dim > 2) moment.xz += we.x * c.e.z, moment.yz += we.y * c.e.z, moment.zz += we.z * c.e.z;
        for (s = 0; s < many; s++) {
            third[s] = sphi_plus(dim, third[s], sph_scale(q[s], we));
            n[s] = sphi_plus(dim, n[s], sph_scale(q[s] * per, we));
            for (r = 0; r < many; r++) lu.a[r][s] += c.V_j * c.g.radial * q[r] * (q[s] * per);
        }
    }
    if (!many || sph_solve_gradient(dim, moment, &inverse, &pivot))
        return sphi_singular_status(k, dim, i, a->cloud.points, a->cloud.list, h_i, dim);
    /* T is compared with the trace of K, which has its size. */
    size = SPH_R(1) / sphi_trace(dim, moment);
    for (s = 0; s < many; s++) {
        t->kn[s] = sphi_sym_times(dim, inverse, n[s]);
        for (r = 0; r < many; r++) {
            lu.a[r][s] = (lu.a[r][s] - sph_dot(dim, third[r], t->kn[s])) * size;
            t->inverse[r * many + s] = r == s ? size : SPH_R(0);
        }
    }
    sphi_lu_factor(many, &lu);
    if (!(lu.pivot_min > SPHI_PIVOT_MIN))
        return sphi_singular_status(k, dim, i, a->cloud.points, a->cloud.list, h_i, dim);
    sphi_lu_solve_columns(many, &lu, many, t->inverse);
    *conditioning = lu.pivot_min < pivot ? lu.pivot_min : pivot;
    return SPH_OK;
}
/* The weight of (u_j - u_i), where m holds the components of M_i + M_j. */
SPH_FN sph_real sphi_tensor_weight(int dim, const sphi_tensor *t, sphi_elliptic_pair c, const sph_real *m)
{
    const sph_real per = sphi_over_q(SPH_R(1), sph_dot(dim, c.e, c.e));
    sph_real q[SPHI_MAX] = {SPH_R(0)}, sum = SPH_R(0);
    const int many = sphi_products(dim, c.e, q);
    int r, s;
    for (s = 0; s < many; s++) {
        sph_real along = SPH_R(0);
        for (r = 0; r < many; r++) along += t->inverse[s * many + r] * m[r];
        sum += along * (q[s] * per - sph_dot(dim, t->kn[s], c.e));
    }
    return c.V_j * c.g.radial * sum;
}

/* The sum of a target, or its row. */
SPH_FN sph_index sphi_elliptic_tensor(sph_kernel k, int dim, sph_cloud cloud, sph_matrices mobility,
                                      const sph_scalars *u, sph_scalar_out out, sph_rows_out rows)
{
    const sph_elliptic_options options = {0, 0, 0, 0, SPH_R(0), {0, 0}, {0, 0}};
    const sphi_elliptic a = sphi_elliptic_of(cloud, mobility.x.x, options, cloud.h.stride == 0);
    sph_shepard none;
    sph_index i, p, failed = 0;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_matrices("mobility", dim, mobility, cloud.points.n);
    if (!error) error = sphi_check_not_negative("mobility", mobility.x.x, cloud.points.n);
    if (!error && dim > 1) error = sphi_check_not_negative("mobility", mobility.y.y, cloud.points.n);
    if (!error && dim > 2) error = sphi_check_not_negative("mobility", mobility.z.z, cloud.points.n);
    if (!error && u) error = sphi_check_field("u", *u, cloud.points.n);
    if (!error && !(u ? out.p : rows.row)) error = sphi_refuse(u ? "out" : "out.row", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    none.nu = SPH_R(1);
    none.gradient.x = none.gradient.y = none.gradient.z = SPH_R(0);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), u_i = u ? sphi_at(*u, i) : SPH_R(0);
        const sph_mat M_i = sphi_matrix_at(dim, mobility, i);
        sphi_tensor t;
        sph_real conditioning, sum = SPH_R(0);
        int state = sphi_tensor_solve(k, dim, &a, i, &t, &conditioning);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            sph_real m[SPHI_MAX] = {SPH_R(0)}, weight = SPH_R(0);
            if (!state) {
                sphi_tensor_sum(dim, M_i, sphi_matrix_at(dim, mobility, j), m);
                weight = sphi_tensor_weight(dim, &t, sphi_elliptic_pair_of(k, dim, &a, none, x_i, h_i, j), m);
            }
            if (u) sum += weight * (sphi_at(*u, j) - u_i);
            else rows.row[p] = weight;
        }
        if (u) {
            if (!sphi_finite(sum)) state = SPH_NOT_FINITE;
            sphi_answer(out, i, state ? SPH_R(0) : sum, state);
        } else {
            if (sphi_row_finite(rows.row, cloud.list.start[i], cloud.list.start[i + 1]))
                state = SPH_NOT_FINITE;
            sphi_row_answer(rows, cloud.list, i, 1, conditioning, state);
        }
        failed += state != SPH_OK;
    }
    return failed;
}

/* div(M grad u) for a full symmetric tensor M of each particle, at any orientation of its axes:
       L u_i = sum_j V_j G sum_s S(M_i + M_j)_s (q_s / |e|^2 - (K^-1 N_s) . e) (u_j - u_i)
   with G = -F_ij, e = x_j - x_i, the products q_s of the components of e (xx, xy, yy, ...), and
       S(M) = T^-1 M,   T_rs = sum_j V_j G q_r (q_s / |e|^2 - (K^-1 N_s) . e),
       N_s = sum_j V_j G e q_s / |e|^2,   K = sum_j V_j G e e^T.
   It is the form of sph_elliptic_rows_anisotropic with all products in the place of the squares, and with
   third moments in T. An addition of this toolkit.
   Exact for linear and quadratic u (M constant), and for products of a linear M and a linear u, at every
   particle that is SPH_OK: also in disorder, and where the support is cut off, if enough neighbours are left.
   The error is O(h^2) in the interior of lattices, and O(h) elsewhere.
   M is the symmetric part of the matrices; it should be positive semidefinite, of which the diagonal is
   checked. Signs: weights have both signs where M is far from isotropic (in 2D and on the axes, beyond a
   ratio of 3), and in disorder; maximum principles are lost then.
   The gradient is (15), means are arithmetic, a pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). The result is
   0 where the state is SPH_TOO_FEW or SPH_SINGULAR: K or T is singular, as it is where the neighbours lie in
   fewer directions than a quadratic form has coefficients (four neighbours on the axes do not see xy).
   Returns the number of targets that are not SPH_OK, or a negative sph_error.
   Atlas: div(m grad u) exact for quadratic fields, inside lattices for cubic fields; order 2 inside
   lattices, 1 in disorder, 1 at boundaries. */
SPH_FN sph_index sph_elliptic_tensor(sph_kernel k, int dim, sph_cloud cloud, sph_matrices mobility,
                                     sph_scalars u, sph_scalar_out out)
{
    const sph_rows_out none = {0, 0, 0, 0, 0, 0};
    return sphi_elliptic_tensor(k, dim, cloud, mobility, &u, out, none);
}
/* The same as rows, with the factor 1. conditioning is the smallest pivot of K (scaled to a unit diagonal)
   and T / tr K. */
SPH_FN sph_index sph_elliptic_rows_tensor(sph_kernel k, int dim, sph_cloud cloud, sph_matrices mobility,
                                          sph_rows_out out)
{
    return sphi_elliptic_tensor(k, dim, cloud, mobility, 0, sph_scalar_out_array(0, 0), out);
}

/* -------- elliptic operator: boundary conditions */

/* What holds at a boundary particle: alpha u + beta m n . grad u is given. alpha = beta = 0 means that the
   particle is not on a boundary. All of the targets; so is the m of the sweep. */
typedef struct sph_boundary {
    sph_vectors normal;      /* n, which points out of the domain */
    sph_scalars alpha, beta; /* of u, and of m n . grad u */
} sph_boundary;

/* Rows of alpha_i u_i + beta_i m_i n_i . grad u for the targets where alpha or beta is not 0. The rows of
   the others are left as they are: write the rows of the operator first, then these over them.
     Dirichlet  alpha = 1, beta = 0.
     Neumann    alpha = 0, beta = 1: m n . grad u, the flux into the domain through a boundary with
                the outer normal n.
     Robin      both are not 0.
   (100) of Lukyanov & Vuik 2020 with the corrected gradient grad u = K^-T sum V_j g (u_j - u_i). Exact for
   linear fields, error O(h). The length of n counts: it multiplies beta. out.diagonal must not be null. A
   row with the state SPH_TOO_FEW or SPH_SINGULAR is 0, with its diagonal. Returns the number of boundary
   targets that are not SPH_OK, or a negative sph_error. */
SPH_FN sph_index sph_elliptic_rows_boundary(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                            sph_elliptic_options options, sph_boundary boundary,
                                            sph_rows_out out)
{
    const sph_vectors normal = boundary.normal;
    const sph_scalars alpha = boundary.alpha, beta = boundary.beta;
    const sphi_elliptic a = sphi_elliptic_of(cloud, m, options, cloud.h.stride == 0);
    sph_index i, p, failed = 0;
    int error = sphi_elliptic_check(k, dim, &a, cloud.last);
    if (!error) error = sphi_check_field("alpha", alpha, cloud.last);
    if (!error) error = sphi_check_field("beta", beta, cloud.last);
    if (!error) error = sphi_check_vectors("normal", dim, normal, cloud.last);
    if (!error && (!out.row || !out.diagonal))
        error = sphi_refuse("out.row, out.diagonal", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real alpha_i = sphi_at(alpha, i), beta_i = sphi_at(beta, i), flux = beta_i * sphi_at(m, i),
                       h_i = sphi_at(cloud.h, i);
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        sph_shepard s;
        sph_elliptic_moments moments;
        sph_mat inverse;
        sph_vec n;
        sph_real conditioning = SPH_R(1), sum = SPH_R(0);
        int state = SPH_OK;
        if (alpha_i == SPH_R(0) && beta_i == SPH_R(0)) continue;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) out.row[p] = SPH_R(0);
        if (beta_i != SPH_R(0)) {
            s = sphi_elliptic_shepard(k, dim, &a, i);
            moments = sphi_elliptic_moments_of(k, dim, &a, s, i);
            conditioning = SPH_R(0);
            if (sph_elliptic_invert(dim, options.gradient, &moments, &inverse, &conditioning))
                state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i, dim);
            else {
                n = sph_scale(flux, sph_mat_times(dim, inverse, sphi_vector_at(dim, normal, i)));
                for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
                    const sphi_elliptic_pair c =
                        sphi_elliptic_pair_of(k, dim, &a, s, x_i, h_i, cloud.list.index[p]);
                    out.row[p] =
                        c.V_j *
                        sph_dot(dim, n, sph_elliptic_gradient_vector(dim, options.gradient, c.e, c.g));
                }
            }
            if (conditioning < options.conditioning_min && !state) state = SPH_ILL_CONDITIONED;
        }
        if (sphi_row_finite(out.row, cloud.list.start[i], cloud.list.start[i + 1])) state = SPH_NOT_FINITE;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) sum += out.row[p];
        if (!sphi_finite(alpha_i - sum)) {
            for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) out.row[p] = SPH_R(0);
            state = SPH_NOT_FINITE;
        }
        sphi_put(out.diagonal, sphi_stride(out.stride), i, sphi_unanswered(state) ? SPH_R(0) : alpha_i - sum);
        sphi_row_answer(out, cloud.list, i, 0, conditioning, state);
        failed += state != SPH_OK;
    }
    return failed;
}

/* ================================================================ rows and matrices
 *
 * A row holds one weight for each entry of the list of a target. The rows may be those of any operator of
 * this file; here is what they are used for, and what they promise. With e = x_j - x_i and the neighbours
 * j along the list, a row stands for
 *     L u_i = sum_p row[p] (u_j - u_i) = diagonal[i] u_i + sum_p row[p] u_j,  diagonal[i] = -sum_p row[p].
 * Sources: Lukyanov & Vuik 2020, arXiv:1711.11351, for M-matrices and von Neumann's growth factor.
 */

/* -------- rows and matrices: sweeps */

/* Checks the targets, their lists, and that the rows are there and finite. diagonal may be missing. */
SPH_FN int sphi_check_rows(sph_cloud cloud, const SPH_GLOBAL sph_real *row, sph_scalars diagonal)
{
    const sph_list list = cloud.list;
    sph_index i, p;
    int error = sphi_check_targets(1, cloud);
    if (!error && !list.start) error = sphi_refuse("list", -1, SPH_ERROR_NULL);
    if (!error && cloud.checked != 1)
        error = sphi_check_entries(cloud.first, cloud.last, list, cloud.points.n, 0);
    if (!error && list.start[cloud.last] > list.start[cloud.first] && !row)
        error = sphi_refuse("row", -1, SPH_ERROR_NULL);
    for (i = cloud.first; SPH_CHECK && !error && i < cloud.last; i++) {
        for (p = list.start[i]; p < list.start[i + 1] && sphi_finite(row[p]);) p++;
        if (p < list.start[i + 1]) error = sphi_refuse("row", i, SPH_ERROR_VALUE);
        else if (diagonal.p && !sphi_finite(sphi_at(diagonal, i)))
            error = sphi_refuse("diagonal", i, SPH_ERROR_VALUE);
    }
    return error;
}

/* out_i = sum_p row[p] (u_j - u_i), which is exactly 0 for constants. If diagonal is given, out_i =
   diagonal[i] u_i + sum_p row[p] u_j. Rows with a factor give factor[i] times the operator. Returns the
   number of targets whose result overflowed (it is 0 then), or a negative sph_error. */
SPH_FN sph_index sph_rows_apply(sph_cloud cloud, const SPH_GLOBAL sph_real *row, sph_scalars diagonal,
                                sph_scalars u, sph_scalar_out out)
{
    int error = sphi_check_rows(cloud, row, diagonal);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("u", u, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real u_i = sphi_at(u, i), less = diagonal.p ? SPH_R(0) : u_i;
        sph_real sum = diagonal.p ? sphi_at(diagonal, i) * u_i : SPH_R(0);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum)
            sum += row[p] * (sphi_at(u, cloud.list.index[p]) - less);
        failed += sphi_store(out, i, sum);
    }
    return failed;
}

/* Counts the rows that are not rows of an M-matrix. A row is one if its off-diagonal weights do not differ
   in sign, and the diagonal has the other sign and at least the size of their sum: Lukyanov & Vuik 2020,
   Definition 7. The dominance need not be strict, because the rows of an operator have the sum 0. A
   connected matrix of such rows, of which one is a Dirichlet row, is monotone: the solution has no maximum
   in the interior. Weights below the rounding error of the largest weight of a row do not count.
   monotone[i] (the pointer may be null) is 1 for rows of an M-matrix, else 0. Returns the number of the
   others, or a negative sph_error. */
SPH_FN sph_index sph_rows_monotone(sph_cloud cloud, const SPH_GLOBAL sph_real *row, sph_scalars diagonal,
                                   SPH_GLOBAL unsigned char *monotone)
{
    int error = sphi_check_rows(cloud, row, diagonal);
    sph_index i, p, others = 0;
    if (!error && !diagonal.p) error = sphi_refuse("diagonal", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real own = sphi_at(diagonal, i);
        sph_real least = SPH_R(0), most = SPH_R(0), sum = SPH_R(0), noise;
        int ok;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            if (row[p] < least) least = row[p];
            if (row[p] > most) most = row[p];
            sum += row[p];
        }
        noise = SPH_R(64) * SPH_EPSILON * (most - least);
        ok = least >= -noise ? own <= -sum + SPH_R(64) * SPH_EPSILON * sum
                             : most <= noise && own >= -sum + SPH_R(64) * SPH_EPSILON * sum;
        if (most <= noise && least >= -noise) ok = own != SPH_R(0); /* a Dirichlet row, of either sign */
        if (monotone) monotone[i] = (unsigned char)ok;
        others += !ok;
    }
    return others;
}

/* The longest stable step of du/dt = L u for the explicit Euler method, by Gershgorin's circles:
       *dt = 2 / max_i (|sum_p row| + sum_p |row|).
   It is certain where all weights are >= 0; it then also keeps maxima from growing. Half of it also keeps
   every mode from changing its sign from step to step. On a uniform lattice with the 2 dim nearest
   neighbours it is dx^2 / (2 dim m). *dt = 1/SPHI_TINY if nothing limits the step. Returns 0 or a
   negative sph_error. */
SPH_FN sph_index sph_rows_time_step(sph_cloud cloud, const SPH_GLOBAL sph_real *row, SPH_GLOBAL sph_real *dt)
{
    int error = dt ? sphi_check_rows(cloud, row, sph_scalars_none()) : sphi_refuse("dt", -1, SPH_ERROR_NULL);
    sph_real largest = SPH_R(0);
    sph_index i, p;
    if (error < 0) return error;
    for (i = cloud.first; i < cloud.last; i++) {
        sph_real sum = SPH_R(0), size = SPH_R(0);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            sum += row[p];
            size += SPHI_ABS(row[p]);
        }
        if (SPHI_ABS(sum) + size > largest) largest = SPHI_ABS(sum) + size;
    }
    *dt = largest > SPH_R(2) * SPHI_TINY ? SPH_R(2) / largest : SPH_R(1) / SPHI_TINY;
    return 0;
}

/* One coordinate of particle i: finite, and on a periodic axis not too many lengths from the origin. */
SPH_FN int sphi_check_coordinate(SPHI_TEXT *name, sph_real x, sph_real length, sph_index i)
{
    if (!SPH_CHECK) return 0;
    if (!sphi_finite(SPH_R(2) * x)) return sphi_refuse(name, i, SPH_ERROR_POSITION);
    if (!(length > SPH_R(0)) || SPHI_ABS(x) <= SPH_R(1048576) * length) return 0;
    return sphi_refuse("points", i, SPH_ERROR_BOX);
}
/* The lengths of the box, and the position of particle i. */
SPH_FN int sphi_check_one(int dim, sph_points x, sph_index i)
{
    const sph_vec at = sphi_point(dim, x, i);
    int error;
    x.n = 0; /* checks the lengths alone */
    error = sphi_check_box(dim, x, SPH_R(0), 1);
    if (!error) error = sphi_check_coordinate("x", at.x, x.box.x, i);
    if (!error && dim > 1) error = sphi_check_coordinate("y", at.y, x.box.y, i);
    if (!error && dim > 2) error = sphi_check_coordinate("z", at.z, x.box.z, i);
    return error;
}
/* The growth factor lambda = 1 + tau sum_p row[p] (exp(i k . e) - 1) of a wave with the wave vector k
   (`wave`) at the first target, for the step u + tau L u (von Neumann). It is stable if |lambda| <= 1.
   (83) of Lukyanov & Vuik 2020. *re and *im are the real and the imaginary part. Returns 0; or 1 if they
   are not finite; or a negative sph_error. It writes nothing with the last two, and without targets. */
SPH_FN sph_index sph_rows_growth(int dim, sph_cloud cloud, const SPH_GLOBAL sph_real *row, sph_real tau,
                                 sph_vec wave, SPH_GLOBAL sph_real *re, SPH_GLOBAL sph_real *im)
{
    const sph_index i = cloud.first;
    const sph_points x = cloud.points;
    const sph_list list = cloud.list;
    sph_real a = SPH_R(0), b = SPH_R(0);
    sph_index p;
    int error = sphi_check_frame(dim, cloud);
    if (!error && (!re || !im)) error = sphi_refuse("re, im", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_rows(sph_cloud_range(cloud, i, i + 1), row, sph_scalars_none());
    if (!error && (!sphi_finite(tau) || !sphi_finite(sph_dot(dim, wave, wave))))
        error = sphi_refuse("tau, wave", -1, SPH_ERROR_VALUE);
    /* Checks only the positions that are needed, because a host calls this for many particles. */
    if (!error) error = sphi_check_one(dim, x, i);
    if (!error && SPH_CHECK)
        for (p = list.start[i]; !error && p < list.start[i + 1]; p++)
            error = sphi_check_one(dim, x, list.index[p]);
    if (error) return sphi_answer_of(error);
    for (p = list.start[i]; p < list.start[i + 1]; p++) {
        const sph_real phase = SPH_R(0.5) * sph_dot(dim, wave,
                                                    sphi_separation(dim, x, sphi_point(dim, x, list.index[p]),
                                                                    sphi_point(dim, x, i)));
        const sph_real sine = SPHI_SIN(phase);
        a -= SPH_R(2) * row[p] * sine * sine; /* cos - 1 = -2 sin^2(phase), without cancellation */
        b += SPH_R(2) * row[p] * sine * SPHI_COS(phase);
    }
    if (!sphi_finite(a * tau) || !sphi_finite(b * tau)) return 1;
    *re = SPH_R(1) + tau * a;
    *im = tau * b;
    return 0;
}

/* -------- rows and matrices: assembly of a matrix in CSR form, in the caller's memory */

#if !SPH_OPENCL
/* The number of entries that sph_csr_assemble needs at most: those of the rows, and one diagonal for each
   target. It is 0 without targets or list. */
SPH_FN int64_t sph_csr_size(sph_cloud cloud)
{
    if (!cloud.list.start || cloud.first < 0 || cloud.last <= cloud.first) return 0;
    return (int64_t)cloud.list.start[cloud.last] - cloud.list.start[cloud.first] + (cloud.last - cloud.first);
}

/* Sorts by column, ascending. Shell's method costs next to nothing for rows that are sorted or nearly so
   (SPH_LIST_SORTED). */
SPH_FN void sphi_sort_entries(sph_index *column, sph_real *value, sph_index n)
{
    sph_index gap = 1, i, j;
    while (gap < n / 3) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (i = gap; i < n; i++) {
            const sph_index c = column[i];
            const sph_real v = value[i];
            for (j = i; j >= gap && column[j - gap] > c; j -= gap) {
                column[j] = column[j - gap];
                value[j] = value[j - gap];
            }
            column[j] = c;
            value[j] = v;
        }
}

/* A matrix in CSR form, in the caller's memory. start has one place for each target and one more; column
   and value have `capacity` places each. */
typedef struct sph_csr {
    sph_index *start, *column;
    sph_real *value;
    int64_t capacity;
} sph_csr;

/* The matrix of the targets first ... last - 1. Row r belongs to target first + r and has the entries
   start[r] ... start[r + 1] - 1. Columns are the numbers of the sources, and ascend in a row. The diagonal
   is always there. If a list names a neighbour twice, its weights are added. drop_zeros = 1 leaves out the
   off-diagonal entries that are 0 (neighbours outside the support, Dirichlet rows); 0 keeps the pattern of
   the lists. start needs last - first + 1 places, column and value need `capacity` places, at least
   sph_csr_size(cloud). *entries (the pointer may be null) is the number of entries. The output must not
   overlap the input.
   Returns 0 or a negative sph_error, and then nothing was written. It is SPH_ERROR_CAPACITY if capacity is
   below sph_csr_size(cloud), and SPH_ERROR_PAIRS if that number is beyond the range of sph_index. */
SPH_FN sph_index sph_csr_assemble(sph_cloud cloud, const sph_real *row, sph_scalars diagonal, int drop_zeros,
                                  sph_csr out, int64_t *entries)
{
    sph_index *const start = out.start, *const column = out.column;
    sph_real *const value = out.value;
    int error = sphi_check_rows(cloud, row, diagonal);
    sph_index i, p, at = 0;
    if (error == SPHI_NO_TARGETS) {
        if (start) start[0] = 0;
        if (entries) *entries = 0;
        return 0;
    }
    if (!error && !diagonal.p) error = sphi_refuse("diagonal", -1, SPH_ERROR_NULL);
    if (!error && (!start || !column || !value)) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (!error && (int64_t)(sph_index)sph_csr_size(cloud) != sph_csr_size(cloud)) error = SPH_ERROR_PAIRS;
    if (!error && out.capacity < sph_csr_size(cloud)) error = SPH_ERROR_CAPACITY;
    if (error) return error;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_index begin = at;
        sph_index end, from;
        start[i - cloud.first] = begin;
        column[at] = i;
        value[at++] = sphi_at(diagonal, i);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            if (drop_zeros && row[p] == SPH_R(0)) continue;
            column[at] = cloud.list.index[p];
            value[at++] = row[p];
        }
        sphi_sort_entries(column + begin, value + begin, at - begin);
        for (end = begin, from = begin + 1; from < at; from++)
            if (column[from] == column[end]) value[end] += value[from];
            else {
                end++;
                column[end] = column[from];
                value[end] = value[from];
            }
        at = end + 1;
    }
    start[cloud.last - cloud.first] = at;
    if (entries) *entries = at;
    return 0;
}
#endif

/* ================================================================ fluid
 *
 * Notation: v_ij = v_i - v_j; vx = v_ij . x_ij, which is negative for particles that approach; rho
 * density, p pressure, c sound speed, m mass, V = m / rho; mu dynamic viscosity, nu = mu / rho kinematic
 * viscosity. Accelerations are
 *     a_i = -sum_j m_j (P_ij + Pi_ij) F_ij x_ij
 * with a pressure term P_ij and an artificial viscosity Pi_ij. Both are symmetric in i and j. If F_ij is
 * symmetric, too (one h for both), the forces of a pair are equal and opposite, and act along the line
 * between the two particles. Momentum and angular momentum are then conserved to round-off. Since F <= 0,
 * positive pressure and viscosity push particles apart.
 *
 * The order of a step: pressures from densities, then wall pressures (sph_wall_adami), then forces; with them
 * the new velocities, and with these the positions. A density by summation is computed before the pressures.
 * A density that follows its rate takes the rate by the new velocities:
 *     v += dt a(x, p(rho));   rho += dt rate(x, v);   x += dt v.
 * Call sph_divergence_difference after the first of these: rate = -rho div v. With the rate by the old
 * velocities, such as the one of the sweep that computes the forces, each step makes sound of the angular
 * frequency w grow by sqrt(1 + (w dt)^2). Then a column at rest boils, unless viscosity is so large, about
 * c^2 dt, that it damps faster: with new velocities the speeds of its particles fall below
 * 0.002 sqrt(g height), with old ones they exceed 2 sqrt(g height) (tests/test_fluid.c).
 *
 * Sources: Korzilius, Schilders & Anthonissen (the paper on particle clustering; equation numbers without
 * a name are those of this paper), Monaghan 1992, ARA&A 30, 543, and those that each function names.
 */

/* -------- fluid: types */

/* One particle of a pair: mass, density, pressure, dynamic viscosity. A function reads only the members
   that its formula names. */
typedef struct sph_fluid_side {
    sph_real m, rho, p, mu;
} sph_fluid_side;
/* How two particles meet: vx = v_ij . x_ij (negative if they approach), their distance r, the h of the
   pair, and the means of their sound speeds and of their densities. */
typedef struct sph_encounter {
    sph_real vx, r, h, c, rho;
} sph_encounter;
/* The coefficients of an artificial viscosity, pure numbers: alpha of the linear term, beta of the
   quadratic term, and eta, which softens r^2 to r^2 + eta^2 h^2. */
typedef struct sph_viscosity_terms {
    sph_real alpha, beta, eta;
} sph_viscosity_terms;
/* Tait's equation of state: the density rho0 at the pressure p0, the sound speed c at this density, and
   the exponent gamma. */
typedef struct sph_tait {
    sph_real rho0, c, gamma, p0;
} sph_tait;

/* -------- fluid: pair functions */

/* What physical and artificial viscosities need. */
#define SPHI_ARE_VISCOUS(i, j, e) \
    ((i).rho > SPH_R(0) && (j).rho > SPH_R(0) && (i).mu >= SPH_R(0) && (j).mu >= SPH_R(0) && \
     (e).r >= SPH_R(0) && (e).h > SPH_R(0))
#define SPHI_IS_ENCOUNTER(e) \
    ((e).r >= SPH_R(0) && (e).h > SPH_R(0) && (e).rho > SPH_R(0) && (e).c >= SPH_R(0))

/* P_ij = p_i / rho_i^2 + p_j / rho_j^2, the variational partner of the summation density. (2.3);
   Monaghan 1992, (3.3). Do not use it where the density jumps: there, it differs between particles of
   the same pressure. Needs rho > 0 on both sides. */
SPH_FN sph_real sph_pressure_pair_monaghan(sph_fluid_side i, sph_fluid_side j)
{
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0));
    return i.p / (i.rho * i.rho) + j.p / (j.rho * j.rho);
}
/* P_ij = (p_i + p_j) / (rho_i rho_j), the partner of the continuity equation in volumes. (5.23), (5.24);
   Colagrossi & Landrini 2003, JCP 191, 448. Valid where the density jumps. Needs rho > 0 on both sides. */
SPH_FN sph_real sph_pressure_pair_colagrossi(sph_fluid_side i, sph_fluid_side j)
{
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0));
    return (i.p + j.p) / (i.rho * j.rho);
}
/* P_ij = (V_i^2 p_i + V_j^2 p_j) / (m_i m_j) with V = m / rho, the partner of rho_i = m_i sum_j W_ij
   (sph_density_number). Hu & Adams 2006, JCP 213, 844, (16). Valid where the density jumps. Needs rho > 0
   and m > 0 on both sides. */
SPH_FN sph_real sph_pressure_pair_hu_adams(sph_fluid_side i, sph_fluid_side j)
{
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0) && i.m > SPH_R(0) && j.m > SPH_R(0));
    return i.m / j.m * i.p / (i.rho * i.rho) + j.m / i.m * j.p / (j.rho * j.rho);
}

/* Artificial viscosity between particles that approach:
       Pi_ij = (-alpha c mu + beta mu^2) / rho >= 0,   mu = h min(vx, 0) / (r^2 + eta^2 h^2)
   with the means of c and rho; here mu is a velocity. Monaghan & Gingold 1983, JCP 52, 374; Monaghan 1992,
   (4.1), (4.2). Usually eta^2 = 0.01. It is 0 for coincident particles. If all pairs counted, the linear
   term would be a kinematic shear viscosity of about alpha h c / (2 (dim + 2)). Needs rho > 0 and c >= 0. */
SPH_FN sph_real sph_viscosity_pair_monaghan(sph_viscosity_terms terms, sph_encounter e)
{
    const sph_real mu = e.h * SPH_R(0.5) * (e.vx - SPHI_ABS(e.vx)) /
                        (e.r * e.r + terms.eta * terms.eta * e.h * e.h + SPHI_TINY);
    SPH_ASSERT(SPHI_IS_ENCOUNTER(e));
    return (terms.beta * mu - terms.alpha * e.c) * mu / e.rho;
}
/* The linear term for all pairs: Pi_ij = -alpha c h vx / ((r^2 + eta^2 h^2) rho), which is negative for
   particles that recede. It acts as the shear and bulk viscosity of the Navier-Stokes equations. Monaghan
   2005, Rep. Prog. Phys. 68, 1703, section 4. Needs rho > 0 and c >= 0. */
SPH_FN sph_real sph_viscosity_pair_linear(sph_viscosity_terms terms, sph_encounter e)
{
    SPH_ASSERT(SPHI_IS_ENCOUNTER(e));
    return -terms.alpha * e.c * e.h * e.vx /
           ((e.r * e.r + terms.eta * terms.eta * e.h * e.h + SPHI_TINY) * e.rho);
}
/* The signal speed of a pair, v_sig = (c_i + c_j + beta |w|) / 2 with w = v_ij . x_ij / r;
   beta_w = beta |w|. c is the sound speed, or sph_mhd_fast_speed in a magnetised gas. Monaghan 1997, JCP
   136, 298; Price 2012, JCP 231, 759, (105). Needs c_i >= 0 and c_j >= 0. */
SPH_FN sph_real sph_signal_speed(sph_real c_i, sph_real c_j, sph_real beta_w)
{
    SPH_ASSERT(!(c_i < SPH_R(0)) && !(c_j < SPH_R(0))); /* NaN: the squares of fast speeds overflowed */
    return SPH_R(0.5) * (c_i + c_j + beta_w);
}
/* Pi_ij = alpha v_sig |w| / rho where particles approach (w < 0), else 0. alpha_speed = alpha v_sig,
   per_rho = 1 / rho. Needs per_rho >= 0. */
SPH_FN sph_real sph_viscosity_signal(sph_real alpha_speed, sph_real w, sph_real per_rho)
{
    SPH_ASSERT(per_rho >= SPH_R(0));
    return SPH_R(0.5) * alpha_speed * (SPHI_ABS(w) - w) * per_rho;
}
/* Artificial viscosity by the signal speed: Pi_ij = alpha v_sig |w| / rho where particles approach, else
   0, with w = vx / r and v_sig = c + beta |w| / 2. Monaghan 1997, JCP 136, 298, (4.13) with K = alpha / 2;
   his v_sig is twice this one, and his beta is 3. It does not depend on h; neither h nor eta is read. Needs
   rho > 0 and c >= 0. */
SPH_FN sph_real sph_viscosity_pair_signal(sph_viscosity_terms terms, sph_encounter e)
{
    const sph_real w = e.vx / (e.r + SPHI_TINY), speed = sph_signal_speed(e.c, e.c, terms.beta * SPHI_ABS(w));
    SPH_ASSERT(e.r >= SPH_R(0) && e.rho > SPH_R(0) && e.c >= SPH_R(0));
    return sph_viscosity_signal(terms.alpha * speed, w, SPH_R(1) / e.rho);
}

/* Physical viscosity of Morris: the coefficient B <= 0 of a_i = sum_j m_j B v_ij,
       B = (mu_i + mu_j) / (rho_i rho_j) F r^2 / (r^2 + eta^2 h^2).
   Exact for linear velocities in the interior of a lattice; in disorder for constant ones only. It conserves
   momentum, but not angular momentum. Morris, Fox & Zhu 1997, JCP 136, 214, (22). Of the pair e, r and h are
   read; eta is taken as it is (0: no softening). f_ij comes from sph_kernel_f_apart. Needs rho > 0 and
   mu >= 0 on both sides. */
SPH_FN sph_real sph_viscosity_mu_pair_morris(sph_fluid_side i, sph_fluid_side j, sph_encounter e,
                                             sph_real f_ij, sph_real eta)
{
    SPH_ASSERT(SPHI_ARE_VISCOUS(i, j, e));
    return (i.mu + j.mu) / (i.rho * j.rho) * f_ij *
           (e.r * e.r / (e.r * e.r + eta * eta * e.h * e.h + SPHI_TINY));
}
/* Physical viscosity of Monaghan & Cleary: the coefficient B of a_i = sum_j m_j B x_ij,
       B = 2 (dim + 2) [2 mu_i mu_j / (mu_i + mu_j)] / (rho_i rho_j) vx / (r^2 + eta^2 h^2) F,
   positive for particles that approach. The force acts along the line between the particles, so that
   angular momentum is conserved, too. Valid where mu jumps. Cleary & Monaghan 1999, JCP 148, 227; Monaghan
   2005, (4.13). The factor 2 (dim + 2) makes it div(mu grad v) / rho for incompressible flow, where the
   neighbours lie alike in all directions (see sph_viscosity_mu_monaghan_cleary). f_ij comes from
   sph_kernel_f_apart. Needs rho > 0 and mu >= 0 on both sides. */
SPH_FN sph_real sph_viscosity_mu_pair_monaghan_cleary(int dim, sph_fluid_side i, sph_fluid_side j,
                                                      sph_encounter e, sph_real f_ij, sph_real eta)
{
    SPH_ASSERT(SPHI_IS_DIM(dim) && SPHI_ARE_VISCOUS(i, j, e));
    return SPH_R(4 * (dim + 2)) * i.mu * (j.mu / (i.mu + j.mu + SPHI_TINY)) / (i.rho * j.rho) * e.vx /
           (e.r * e.r + eta * eta * e.h * e.h + SPHI_TINY) * f_ij;
}

/* The bulk viscosities (dynamic) of the two particles of a pair. */
typedef struct sph_bulk_pair {
    sph_real i, j;
} sph_bulk_pair;
/* The coefficients of a viscous force of a pair: a_i = sum_j m_j (along_v v_ij + along_x x_ij). */
typedef struct sph_viscosity_force {
    sph_real along_v, along_x;
} sph_viscosity_force;
/* Physical viscosity of Espanol & Revenga, with shear and bulk viscosity: the coefficients
       along_v = (2 mu - b) F r^2 / (rho_i rho_j (r^2 + eta^2 h^2)),
       along_x = (dim + 2) b vx F / (rho_i rho_j (r^2 + eta^2 h^2)),   b = zeta + (1 - 2 / dim) mu
   of div(mu (grad v + (grad v)^T - (2 / dim) div v) + zeta div v) / rho in dim dimensions. mu and zeta are
   the harmonic means of the two particles. Exact for linear v in the interior of a lattice; in disorder for
   constant ones only. Momentum is conserved; angular momentum too where 2 mu = b, and the force is then that
   of Monaghan & Cleary. For b = 0 (in 2D zeta = 0) it is Morris's with the harmonic mean. Kinetic energy
   falls in every pair if 2 mu >= b, that is, zeta <= (1 + 2 / dim) mu (and, in 1D, always). Espanol & Revenga
   2003, Phys. Rev. E 67, 026705; Monaghan 2005, section 4. mu_i and mu_j are i.mu and j.mu. Of the pair e,
   vx, r and h are read. f_ij comes from sph_kernel_f_apart. Needs rho > 0, mu >= 0 and zeta >= 0 on both
   sides. */
SPH_FN sph_viscosity_force sph_viscosity_mu_pair_espanol_revenga(int dim, sph_fluid_side i, sph_fluid_side j,
                                                                 sph_bulk_pair zeta, sph_encounter e,
                                                                 sph_real f_ij, sph_real eta)
{
    const int harmonic = (int)SPH_MOBILITY_HARMONIC;
    const sph_real shear2 = sph_mobility_pair(harmonic, i.mu, j.mu, SPH_R(0)), /* twice the means */
                   bulk2 = sph_mobility_pair(harmonic, zeta.i, zeta.j, SPH_R(0)),
                   b = SPH_R(0.5) * (bulk2 + (SPH_R(1) - SPH_R(2) / SPH_R(dim)) * shear2),
                   common = f_ij / (i.rho * j.rho * (e.r * e.r + eta * eta * e.h * e.h + SPHI_TINY));
    sph_viscosity_force c;
    SPH_ASSERT(SPHI_IS_DIM(dim) && SPHI_ARE_VISCOUS(i, j, e));
    c.along_v = (shear2 - b) * common * e.r * e.r;
    c.along_x = SPH_R(dim + 2) * b * common * e.vx;
    return c;
}

/* F of a pair, but 0 for particles that coincide (closer than 1e-12 h): their direction consists of
   rounding errors. It is written with copysign, because a comparison would keep loops from vectorising. */
SPH_FN sph_real sph_kernel_f_apart(sph_kernel k, int dim, sph_real r, sph_real h)
{
    return sph_kernel_f(k, dim, r, h) * (SPH_R(0.5) + SPHI_COPYSIGN(SPH_R(0.5), r - SPH_R(1e-12) * h));
}
/* What j adds to drho_i/dt: m_j v_ij . grad_i W_ij = m_j vx F_ij, the rate of the summation density.
   (2.2); Monaghan 1992, (2.16). */
SPH_FN sph_real sph_density_rate_pair_mass(sph_fluid_side j, sph_real vx, sph_real f_ij)
{
    return j.m * vx * f_ij;
}
/* The same in volumes, valid where the density jumps: rho_i (m_j / rho_j) v_ij . grad_i W_ij. (5.23). Needs
   rho > 0 on both sides. */
SPH_FN sph_real sph_density_rate_pair_volume(sph_fluid_side i, sph_fluid_side j, sph_real vx, sph_real f_ij)
{
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0));
    return j.m * i.rho / j.rho * vx * f_ij;
}

/* What j adds to i, or a sum of such contributions: the acceleration, the density rate drho_i/dt, and the
   heating du_i/dt of viscosity, u being the thermal energy per mass. */
typedef struct sph_fluid_change {
    sph_vec acceleration;
    sph_real rate, heating;
} sph_fluid_change;

/* Acceleration -m_j (P_ij + Pi_ij) F x_ij and heating m_j Pi_ij v_ij . x_ij F / 2. push = P_ij + Pi_ij,
   viscosity = Pi_ij. */
SPH_FN sph_fluid_change sphi_fluid_change(sph_real m_j, sph_real push, sph_real viscosity, sph_vec x_ij,
                                          sph_real vx, sph_real f_ij, sph_real rate)
{
    sph_fluid_change c;
    c.acceleration = sph_scale(-(m_j * push * f_ij), x_ij);
    c.rate = rate;
    c.heating = SPH_R(0.5) * viscosity * (m_j * vx * f_ij);
    return c;
}
/* A whole interaction: what j adds to i. The sweep sph_fluid_rates_monaghan is the sum of these.
   vx = v_ij . x_ij; f_ij comes from sph_kernel_f_apart; viscosity is Pi_ij, or 0. The density rate is that
   of sph_density_rate_pair_mass. This and the next two need what their pressure term needs. */
SPH_FN sph_fluid_change sph_fluid_pair_monaghan(sph_fluid_side i, sph_fluid_side j, sph_vec x_ij, sph_real vx,
                                                sph_real f_ij, sph_real viscosity)
{
    return sphi_fluid_change(j.m, sph_pressure_pair_monaghan(i, j) + viscosity, viscosity, x_ij, vx, f_ij,
                             sph_density_rate_pair_mass(j, vx, f_ij));
}
/* The same with the pressure term of Colagrossi & Landrini and the density rate
   sph_density_rate_pair_volume. */
SPH_FN sph_fluid_change sph_fluid_pair_colagrossi(sph_fluid_side i, sph_fluid_side j, sph_vec x_ij,
                                                  sph_real vx, sph_real f_ij, sph_real viscosity)
{
    return sphi_fluid_change(j.m, sph_pressure_pair_colagrossi(i, j) + viscosity, viscosity, x_ij, vx, f_ij,
                             sph_density_rate_pair_volume(i, j, vx, f_ij));
}
/* The same with the pressure term of Hu & Adams and the density rate sph_density_rate_pair_volume. */
SPH_FN sph_fluid_change sph_fluid_pair_hu_adams(sph_fluid_side i, sph_fluid_side j, sph_vec x_ij, sph_real vx,
                                                sph_real f_ij, sph_real viscosity)
{
    return sphi_fluid_change(j.m, sph_pressure_pair_hu_adams(i, j) + viscosity, viscosity, x_ij, vx, f_ij,
                             sph_density_rate_pair_volume(i, j, vx, f_ij));
}

/* XSPH: 2 m_j / (rho_i + rho_j) W_ij, the weight of (v_j - v_i). Epsilon times the sum is added to the
   velocity that moves particle i. Monaghan 1989, JCP 82, 1. Needs rho > 0 on both sides. */
SPH_FN sph_real sph_velocity_pair_xsph(sph_fluid_side i, sph_fluid_side j, sph_real w_ij)
{
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0));
    return SPH_R(2) * j.m / (i.rho + j.rho) * w_ij;
}

/* Sums over the fluid particles j in front of a wall particle w: weight is the sum of W, p that of
   (p_j + rho_j (g - a_w) . x_wj) W, and v that of v_j W. */
typedef struct sph_wall_sums {
    sph_real weight, p;
    sph_vec v;
} sph_wall_sums;
/* What the fluid particle j adds to these sums. i is the wall particle: x_ij points from j to the wall
   particle. gravity = g - a_w, gravity less the acceleration of the wall. Adami, Hu & Adams 2012, JCP 231,
   7057, (22), (27). */
SPH_FN sph_wall_sums sph_wall_pair_adami(int dim, sph_fluid_side j, sph_vec v_j, sph_vec x_ij,
                                         sph_vec gravity, sph_real w_ij)
{
    sph_wall_sums c;
    c.weight = w_ij;
    c.p = w_ij * (j.p + j.rho * sph_dot(dim, gravity, x_ij));
    c.v = sph_scale(w_ij, v_j);
    return c;
}
/* The pressure of the wall particle: the sum p over that of W. Needs weight > 0. */
SPH_FN sph_real sph_wall_pressure(sph_wall_sums s)
{
    SPH_ASSERT(s.weight > SPH_R(0));
    return s.p / s.weight;
}
/* The mean velocity of the fluid in front of the wall: the sum v over that of W. Needs weight > 0. */
SPH_FN sph_vec sph_wall_fluid_velocity(sph_wall_sums s)
{
    sph_vec mean;
    SPH_ASSERT(s.weight > SPH_R(0));
    mean.x = s.v.x / s.weight;
    mean.y = s.v.y / s.weight;
    mean.z = s.v.z / s.weight;
    return mean;
}
/* The weight of p_j in the row p_w - sum p_j W / sum W of a wall particle, whose sums are s. w_ij is W of
   this neighbour, as it was given to sph_wall_pair_adami. Needs weight > 0. */
SPH_FN sph_real sph_wall_row_weight(sph_real w_ij, sph_wall_sums s)
{
    SPH_ASSERT(s.weight > SPH_R(0));
    return -w_ij / s.weight;
}
/* The mirror image of x in the plane through `at` with the normal n: x - 2 ((x - at) . n) n / n^2. The length
   of n does not matter, if its square is in the range of numbers. If n^2 = 0, it is x. A wall particle x_w
   has its mirror point in the fluid, where sph_interpolate_liu or _mls gives a value that sph_fit_extend
   carries back (mDBC). A fluid particle x_j has a mirror particle behind the wall: its pressure is what
   sph_wall_pair_adami(dim, j, v_j, x_ij, gravity, 1) gives as p, x_ij pointing from x_j to its image, and its
   velocity one of the next two functions with v_j for the mean. */
SPH_FN sph_vec sph_wall_mirror(int dim, sph_vec x, sph_vec at, sph_vec normal)
{
    const sph_real nn = sph_dot(dim, normal, normal), along = sph_dot(dim, sph_subtract(dim, x, at), normal);
    return sph_subtract(dim, x, sph_scale(nn > SPH_R(0) ? SPH_R(2) * along / nn : SPH_R(0), normal));
}
/* The velocity of a wall particle with no slip, (23): 2 u - mean. u (`wall`) is the wall's own velocity,
   mean comes from sph_wall_fluid_velocity. */
SPH_FN sph_vec sph_wall_velocity_no_slip(int dim, sph_vec mean, sph_vec wall)
{
    return sph_subtract(dim, sph_scale(SPH_R(2), wall), mean);
}
/* The velocity of a wall particle with free slip: the mean, of which the part along the normal is
   reversed relative to the wall, mean - 2 ((mean - u) . n) n / n^2. The length of n does not matter, if
   its square is in the range of numbers. If n^2 = 0, it is the mean. */
SPH_FN sph_vec sph_wall_velocity_free_slip(int dim, sph_vec mean, sph_vec wall, sph_vec normal)
{
    return sph_wall_mirror(dim, mean, wall, normal); /* the same formula for velocities */
}

/* p = p0 + rho0 c^2 / gamma ((rho / rho0)^gamma - 1), the equation of state that is called after Tait, in
   Macdonald's form (2.4). For gamma = 1 it is p0 + c^2 (rho - rho0); gamma = 7 is usual for water. p0 is
   the pressure at rho0, 0 or a background pressure. Cole 1948; Macdonald 1966, Rev. Mod. Phys. 38, 669;
   Monaghan 1994, JCP 110, 399. Needs rho >= 0, rho0 > 0, c >= 0 and gamma > 0. */
SPH_FN sph_real sph_pressure_tait(sph_real rho, sph_tait t)
{
    const sph_real e = rho / t.rho0, stiffness = t.rho0 * t.c * t.c / t.gamma;
    SPH_ASSERT(rho >= SPH_R(0) && t.rho0 > SPH_R(0) && t.c >= SPH_R(0) && t.gamma > SPH_R(0));
    return t.p0 + stiffness * (t.gamma == SPH_R(1) ? e - SPH_R(1) : SPHI_POW(e, t.gamma) - SPH_R(1));
}
/* The density at the pressure p, the inverse of sph_pressure_tait. It is 0 where no density
   has this pressure. Needs rho0 > 0, c > 0 and gamma > 0. */
SPH_FN sph_real sph_density_tait(sph_real p, sph_tait t)
{
    const sph_real e = SPH_R(1) + t.gamma * (p - t.p0) / (t.rho0 * t.c * t.c);
    SPH_ASSERT(sphi_finite(p) && t.rho0 > SPH_R(0) && t.c > SPH_R(0) && t.gamma > SPH_R(0));
    if (!(e > SPH_R(0))) return SPH_R(0);
    return t.rho0 * (t.gamma == SPH_R(1) ? e : SPHI_POW(e, SPH_R(1) / t.gamma));
}
/* The sound speed sqrt(dp/drho) = c (rho / rho0)^((gamma - 1) / 2). Needs what sph_pressure_tait needs, and
   rho > 0 if gamma < 1. */
SPH_FN sph_real sph_sound_speed_tait(sph_real rho, sph_tait t)
{
    SPH_ASSERT((rho > SPH_R(0) || (rho >= SPH_R(0) && t.gamma >= SPH_R(1))) && t.rho0 > SPH_R(0) &&
               t.c >= SPH_R(0) && t.gamma > SPH_R(0));
    return t.gamma == SPH_R(1) ? t.c : t.c * SPHI_POW(rho / t.rho0, SPH_R(0.5) * (t.gamma - SPH_R(1)));
}

/* a / b, or 1/SPHI_TINY if b is so small that nothing is limited. A NaN is not small: it stays one. */
SPH_FN sph_real sphi_limit(sph_real a, sph_real b)
{
    return b <= SPHI_TINY * a ? SPH_R(1) / SPHI_TINY : a / b;
}
/* The longest step of an explicit scheme for one particle, by sound (Courant): 0.25 h / (c + |v|);
   speed = |v|. Source of this and the next two functions: Monaghan 1992; Morris, Fox & Zhu 1997,
   (33)-(35). Take the least of all particles. Where nothing limits the step the answer is 1/SPHI_TINY, or
   for the force 0.25 sqrt(1/SPHI_TINY). Needs c >= 0 and speed >= 0. */
SPH_FN sph_real sph_time_step_sound(sph_real h, sph_real c, sph_real speed)
{
    SPH_ASSERT(h > SPH_R(0) && c >= SPH_R(0) && speed >= SPH_R(0));
    return sphi_limit(SPH_R(0.25) * h, c + speed);
}
/* The longest step by the force: 0.25 sqrt(h / |a|); acceleration = |a|. Needs acceleration >= 0. */
SPH_FN sph_real sph_time_step_force(sph_real h, sph_real acceleration)
{
    SPH_ASSERT(h > SPH_R(0) && acceleration >= SPH_R(0));
    return SPH_R(0.25) * SPHI_SQRT(sphi_limit(h, acceleration));
}
/* The longest step by viscosity: 0.125 h^2 / nu, with the kinematic viscosity nu. A form that resists
   compression with more than it resists shear needs the larger of the two: 3 nu for Monaghan & Cleary,
   (2 - 2 / dim) nu plus the bulk viscosity for Espanol & Revenga. Needs nu >= 0. */
SPH_FN sph_real sph_time_step_viscous_nu(sph_real h, sph_real nu)
{
    SPH_ASSERT(h > SPH_R(0) && nu >= SPH_R(0));
    return sphi_limit(SPH_R(0.125) * h * h, nu);
}

/* -------- fluid: sweeps */

/* rho_i = m_i sum_j W_ij(h_i) with the particle itself: the number density times the particle's own mass,
   so that a light particle beside heavy ones keeps its density. V_i = m_i / rho_i is then 1 / sum_j W_ij.
   Hu & Adams 2006, JCP 213, 844, (15). Only the m of the targets is read.
   Returns the number of targets whose density overflowed (it is 0 then), or a negative sph_error.
   Atlas: value exact for nothing; order 0 inside lattices, 0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_density_number(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m, sph_scalar_out out)
{
    int error = sphi_check_weights(k, dim, cloud, "m", m, cloud.last);
    sph_index i, p, failed = 0;
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real sum = sph_kernel_w(k, dim, SPH_R(0), h_i);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum)
            sum += sph_kernel_w(
                k, dim,
                sph_length(dim, sphi_separation(dim, cloud.points, x_i,
                                                sphi_point(dim, cloud.points, cloud.list.index[p]))),
                h_i);
        failed += sphi_store(out, i, sphi_at(m, i) * sum);
    }
    return failed;
}

/* Which artificial viscosity Pi_ij. */
typedef enum sph_viscosity {
    SPH_VISCOSITY_NONE,
    SPH_VISCOSITY_MONAGHAN, /* sph_viscosity_pair_monaghan: pairs that approach */
    SPH_VISCOSITY_LINEAR,   /* sph_viscosity_pair_linear: all pairs */
    SPH_VISCOSITY_SIGNAL    /* sph_viscosity_pair_signal: pairs that approach, by the signal speed */
} sph_viscosity;

/* The state of a fluid, one number for each particle, all sources. A pair uses (h_i + h_j) / 2: lists by
   SPH_MEAN, or by any criterion if all particles have the same h. */
typedef struct sph_fluid {
    sph_scalars m, rho, p, c; /* mass, density, pressure, sound speed >= 0 (for artificial viscosity) */
    sph_vectors v;            /* velocity */
    int viscosity;            /* the artificial viscosity: an sph_viscosity */
    sph_real alpha, beta;     /* its coefficients, pure numbers */
    sph_real eta; /* softens r^2 to r^2 + eta^2 h^2; 0 means the usual 0.1, a negative number none */
} sph_fluid;

/* Where rates go. rate, heating and status may be null. The stride is that of rate and
   heating, in sph_real. */
typedef struct sph_fluid_out {
    sph_vector_out acceleration;
    SPH_GLOBAL sph_real *rate, *heating; /* drho/dt, and du/dt by viscosity (u: thermal energy per mass) */
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_fluid_out;

enum { SPHI_MONAGHAN, SPHI_COLAGROSSI, SPHI_HU_ADAMS };
/* The eta of sph_fluid as it is used: 0 means 0.1, a negative number means 0. */
SPH_FN sph_real sphi_softening(sph_real eta)
{
    return eta == SPH_R(0) ? SPH_R(0.1) : eta < SPH_R(0) ? SPH_R(0) : eta;
}
/* The values of particle i. Those that a sweep does not read are 0. */
enum { SPHI_READ_M = 1, SPHI_READ_RHO = 2, SPHI_READ_P = 4, SPHI_READ_MU = 8 };
SPH_FN sph_fluid_side sphi_fluid_side(int reads, const sph_fluid *f, sph_scalars mu, sph_index i)
{
    sph_fluid_side a;
    a.m = reads & SPHI_READ_M ? sphi_at(f->m, i) : SPH_R(0);
    a.rho = reads & SPHI_READ_RHO ? sphi_at(f->rho, i) : SPH_R(0);
    a.p = reads & SPHI_READ_P ? sphi_at(f->p, i) : SPH_R(0);
    a.mu = reads & SPHI_READ_MU ? sphi_at(mu, i) : SPH_R(0);
    return a;
}
SPH_FN sph_real sphi_fluid_viscosity(int viscosity, sph_viscosity_terms terms, sph_encounter e)
{
    if (viscosity == (int)SPH_VISCOSITY_MONAGHAN) return sph_viscosity_pair_monaghan(terms, e);
    if (viscosity == (int)SPH_VISCOSITY_LINEAR) return sph_viscosity_pair_linear(terms, e);
    return viscosity == (int)SPH_VISCOSITY_SIGNAL ? sph_viscosity_pair_signal(terms, e) : SPH_R(0);
}
SPH_FN sph_fluid_change sphi_fluid_pair(int form, sph_fluid_side i, sph_fluid_side j, sph_vec x_ij,
                                        sph_real vx, sph_real f_ij, sph_real viscosity)
{
    if (form == SPHI_MONAGHAN) return sph_fluid_pair_monaghan(i, j, x_ij, vx, f_ij, viscosity);
    if (form == SPHI_COLAGROSSI) return sph_fluid_pair_colagrossi(i, j, x_ij, vx, f_ij, viscosity);
    return sph_fluid_pair_hu_adams(i, j, x_ij, vx, f_ij, viscosity);
}

SPH_FN sph_index sphi_fluid_range(int form, int uniform, sph_kernel k, int dim, sph_cloud cloud,
                                  const sph_fluid *f, sph_fluid_out out)
{
    const size_t stride = sphi_stride(out.stride);
    const int reads = SPHI_READ_M + SPHI_READ_RHO + SPHI_READ_P;
    const int viscous = f->viscosity != (int)SPH_VISCOSITY_NONE;
    sph_viscosity_terms terms;
    sph_index i, p, failed = 0;
    terms.alpha = f->alpha;
    terms.beta = f->beta;
    terms.eta = sphi_softening(f->eta);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, f->v, i);
        const sph_real h_i = sphi_at(cloud.h, i), c_i = viscous ? sphi_at(f->c, i) : SPH_R(0);
        const sph_fluid_side own = sphi_fluid_side(reads, f, f->m, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0), rate = SPH_R(0), heating = SPH_R(0);
        sph_vec sum;
        int lost;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az, rate, heating) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_fluid_side other = sphi_fluid_side(reads, f, f->m, j);
            sph_fluid_change c;
            sph_encounter e;
            e.vx = sph_dot(dim, sph_subtract(dim, v_i, sphi_vector_at(dim, f->v, j)), x_ij);
            e.r = sph_length(dim, x_ij);
            e.h = sphi_mean_h(uniform, cloud.h, h_i, j);
            e.c = viscous ? SPH_R(0.5) * (c_i + sphi_at(f->c, j)) : SPH_R(0);
            e.rho = SPH_R(0.5) * (own.rho + other.rho);
            c = sphi_fluid_pair(form, own, other, x_ij, e.vx, sph_kernel_f_apart(k, dim, e.r, e.h),
                                sphi_fluid_viscosity(f->viscosity, terms, e));
            ax += c.acceleration.x;
            if (dim > 1) ay += c.acceleration.y;
            if (dim > 2) az += c.acceleration.z;
            rate += c.rate;
            heating += c.heating;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        lost = sphi_store_vector(dim, out.acceleration, i, sum);
        lost |= sphi_put(out.rate, stride, i, rate);
        lost |= sphi_put(out.heating, stride, i, heating);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}
SPH_FN sph_index sphi_fluid_rates(int form, sph_kernel k, int dim, sph_cloud cloud, sph_fluid f,
                                  sph_fluid_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "m", f.m);
    if (!error && (f.viscosity < 0 || f.viscosity > (int)SPH_VISCOSITY_SIGNAL))
        error = sphi_refuse("fluid.viscosity", -1, SPH_ERROR_VALUE);
    if (!error && (!sphi_finite(f.alpha) || !sphi_finite(f.beta) || !sphi_finite(f.eta)))
        error = sphi_refuse("fluid.alpha, beta, eta", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_positive("m", f.m, cloud.points.n);
    if (!error) error = sphi_check_positive("rho", f.rho, cloud.points.n);
    if (!error) error = sphi_check_field("p", f.p, cloud.points.n);
    if (!error && f.viscosity != (int)SPH_VISCOSITY_NONE)
        error = sphi_check_not_negative("c", f.c, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, f.v, cloud.points.n);
    if (!error) error = sphi_check_out("out.acceleration", dim, out.acceleration);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_fluid_range(form, 0, k, dim, cloud, &f, out)
                          : sphi_fluid_range(form, 1, k, dim, cloud, &f, out);
}

/* Acceleration, density rate and viscous heating of the targets, in one pass:
       a_i      = -sum_j m_j (P_ij + Pi_ij) grad_i W_ij,
       du_i/dt  = sum_j m_j Pi_ij v_ij . grad_i W_ij / 2,
       drho_i/dt by sph_density_rate_pair_mass or sph_density_rate_pair_volume.
     monaghan    (2.2), (2.3): drho_i/dt = sum_j m_j v_ij . grad_i W_ij.
     colagrossi  (5.23), (5.24): drho_i/dt = rho_i sum_j m_j / rho_j v_ij . grad_i W_ij.
     hu_adams    weighted by volumes. The density comes from sph_density_number, or from the rate (5.23),
                 which is the one that this sweep writes.
   Signs: F <= 0, so that pressure pushes particles apart. Gravity and the work of the pressure on u
   are not contained. out.rate is that of the velocities given: see the order of a step above. out.rate and
   out.heating may be null. Pairs closer than 1e-12 h exert no force on each other (sph_coincident_count finds
   them). Returns the number of targets of which a result overflowed (it is 0 then), or a negative sph_error:
   SPH_ERROR_VALUE also for densities and masses that are not positive, and sound speeds that are negative.
   Atlas: gradient exact for nothing, inside lattices for constants; order 0 inside lattices, -1 in
   disorder, -1 at boundaries.
   Atlas: keeps momentum and angular momentum; energy never grows. */
SPH_FN sph_index sph_fluid_rates_monaghan(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                          sph_fluid_out out)
{
    return sphi_fluid_rates(SPHI_MONAGHAN, k, dim, cloud, fluid, out);
}
/* The same by Colagrossi & Landrini, (5.23), (5.24): for densities that jump. */
SPH_FN sph_index sph_fluid_rates_colagrossi(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                            sph_fluid_out out)
{
    return sphi_fluid_rates(SPHI_COLAGROSSI, k, dim, cloud, fluid, out);
}
/* The same by Hu & Adams, weighted by volumes: for densities that jump. */
SPH_FN sph_index sph_fluid_rates_hu_adams(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                          sph_fluid_out out)
{
    return sphi_fluid_rates(SPHI_HU_ADAMS, k, dim, cloud, fluid, out);
}

/* Dynamic viscosities of each particle, neither negative: mu (shear) and zeta (bulk). */
typedef struct sph_shear_bulk {
    sph_scalars shear, bulk;
} sph_shear_bulk;

enum { SPHI_MORRIS, SPHI_MONAGHAN_CLEARY, SPHI_ESPANOL_REVENGA };
SPH_FN sph_index sphi_viscous(int form, sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                              sph_shear_bulk viscosities, sph_vector_out a)
{
    const sph_scalars mu = viscosities.shear, bulk = viscosities.bulk;
    const sph_scalars m = fluid.m, rho = fluid.rho;
    const sph_vectors v = fluid.v;
    const sph_real eta = sphi_softening(fluid.eta);
    int error = sphi_check_sweep(k, dim, cloud, "m", m);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_positive("rho", rho, cloud.points.n);
    if (!error) error = sphi_check_not_negative("mu", mu, cloud.points.n);
    if (!error && form == SPHI_ESPANOL_REVENGA)
        error = sphi_check_not_negative("mu.bulk", bulk, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error) error = sphi_check_out("a", dim, a);
    if (!error && !sphi_finite(fluid.eta)) error = sphi_refuse("fluid.eta", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, v, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_fluid_side own = sphi_fluid_side(SPHI_READ_RHO + SPHI_READ_MU, &fluid, mu, i);
        const sph_real bulk_i = form == SPHI_ESPANOL_REVENGA ? sphi_at(bulk, i) : SPH_R(0);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          v_ij = sph_subtract(dim, v_i, sphi_vector_at(dim, v, j));
            const sph_real r = sph_length(dim, x_ij), h_ij = sphi_mean_h(0, cloud.h, h_i, j),
                           f_ij = sph_kernel_f_apart(k, dim, r, h_ij), m_j = sphi_at(m, j);
            const sph_fluid_side other = sphi_fluid_side(SPHI_READ_RHO + SPHI_READ_MU, &fluid, mu, j);
            sph_encounter e;
            sph_viscosity_force b;
            e.c = e.rho = SPH_R(0);
            e.vx = sph_dot(dim, v_ij, x_ij);
            e.r = r;
            e.h = h_ij;
            b.along_v = b.along_x = SPH_R(0);
            if (form == SPHI_MORRIS) b.along_v = sph_viscosity_mu_pair_morris(own, other, e, f_ij, eta);
            else if (form == SPHI_MONAGHAN_CLEARY)
                b.along_x = sph_viscosity_mu_pair_monaghan_cleary(dim, own, other, e, f_ij, eta);
            else {
                sph_bulk_pair zeta;
                zeta.i = bulk_i;
                zeta.j = sphi_at(bulk, j);
                b = sph_viscosity_mu_pair_espanol_revenga(dim, own, other, zeta, e, f_ij, eta);
            }
            b.along_v *= m_j;
            b.along_x *= m_j;
            if (form != SPHI_MONAGHAN_CLEARY) {
                ax += b.along_v * v_ij.x;
                if (dim > 1) ay += b.along_v * v_ij.y;
                if (dim > 2) az += b.along_v * v_ij.z;
            }
            if (form != SPHI_MORRIS) {
                ax += b.along_x * x_ij.x;
                if (dim > 1) ay += b.along_x * x_ij.y;
                if (dim > 2) az += b.along_x * x_ij.z;
            }
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        failed += sphi_store_vector(dim, a, i, sum);
    }
    return failed;
}
SPH_FN sph_shear_bulk sphi_shear_alone(sph_scalars mu)
{
    sph_shear_bulk viscosities;
    viscosities.shear = mu;
    viscosities.bulk = sph_scalars_none();
    return viscosities;
}
/* a_i = (1 / rho) div(mu grad v), physical viscosity by sph_viscosity_mu_pair_morris. mu is the dynamic
   viscosity (nu rho) of each particle, and not negative. Of fluid, the members m, rho, v and eta are read.
   Pairs closer than 1e-12 h exert no force on each other. Returns the number of targets whose result
   overflowed (it is 0 then), or a negative sph_error.
   Atlas: Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_viscosity_mu_morris(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                         sph_scalars mu, sph_vector_out acceleration)
{
    return sphi_viscous(SPHI_MORRIS, k, dim, cloud, fluid, sphi_shear_alone(mu), acceleration);
}
/* The same by sph_viscosity_mu_pair_monaghan_cleary. It also conserves angular momentum. But on a square
   lattice that nothing has disturbed it depends on the direction: with the cubic spline and h = 1.2 dx a
   shear wave is damped as by
       0.79 mu along an axis and 1.17 mu along the diagonal,
   where Morris's form has 0.98 mu. A longer h and disorder make the difference smaller, and a hexagonal
   lattice has none: see the table of examples/OPERATORS.md.
   Atlas: Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_viscosity_mu_monaghan_cleary(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                                  sph_scalars mu, sph_vector_out acceleration)
{
    return sphi_viscous(SPHI_MONAGHAN_CLEARY, k, dim, cloud, fluid, sphi_shear_alone(mu), acceleration);
}
/* The acceleration by shear and bulk viscosity, by sph_viscosity_mu_pair_espanol_revenga: see there for the
   stress tensor, and for which zeta the kinetic energy can only fall. Else as the two above.
   Atlas: Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_viscosity_mu_espanol_revenga(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                                  sph_shear_bulk mu, sph_vector_out acceleration)
{
    return sphi_viscous(SPHI_ESPANOL_REVENGA, k, dim, cloud, fluid, mu, acceleration);
}

/* What XSPH adds to the velocity that moves a particle: epsilon sum_j 2 m_j / (rho_i + rho_j) (v_j - v_i)
   W_ij. Monaghan 1989, JCP 82, 1. epsilon = 0.5 is usual. It conserves linear momentum, and also angular
   momentum if it moves particles only: do not add it to the velocity that a particle keeps. Of fluid, the
   members m, rho and v are read. Returns the number of targets whose result overflowed (it is 0 then), or a
   negative sph_error. */
SPH_FN sph_index sph_velocity_xsph(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid, sph_real epsilon,
                                   sph_vector_out change)
{
    const sph_scalars m = fluid.m, rho = fluid.rho;
    const sph_vectors v = fluid.v;
    int error = sphi_check_sweep(k, dim, cloud, "m", m);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_positive("rho", rho, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error) error = sphi_check_out("change", dim, change);
    if (!error && !sphi_finite(epsilon)) error = sphi_refuse("epsilon", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, v, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_fluid_side own = sphi_fluid_side(SPHI_READ_RHO, &fluid, rho, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az) {
            const sph_index j = cloud.list.index[p];
            const sph_vec v_ij = sph_subtract(dim, v_i, sphi_vector_at(dim, v, j));
            const sph_real r =
                sph_length(dim, sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)));
            const sph_real w_ij = sph_kernel_w(k, dim, r, sphi_mean_h(0, cloud.h, h_i, j)),
                           b = -epsilon *
                               sph_velocity_pair_xsph(
                                   own, sphi_fluid_side(SPHI_READ_M + SPHI_READ_RHO, &fluid, rho, j), w_ij);
            ax += b * v_ij.x;
            if (dim > 1) ay += b * v_ij.y;
            if (dim > 2) az += b * v_ij.z;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        failed += sphi_store_vector(dim, change, i, sum);
    }
    return failed;
}

/* The fluid and the wall. One number for each particle, all sources; velocity and normal: of the targets. */
typedef struct sph_wall {
    /* share: 1 for fluid particles, 0 for all others. rho and p: density and pressure of the fluid. */
    sph_scalars share, rho, p;
    /* v: velocity of the fluid. velocity: the wall's own velocity u. normal: normal of the wall, of any
       length, for free slip; null arrays mean no slip. */
    sph_vectors v, velocity, normal;
    sph_vec gravity; /* g - a_w: gravity less the acceleration of the wall */
} sph_wall;
/* Where pressure and velocity of the wall particles go. */
typedef struct sph_wall_out {
    SPH_GLOBAL sph_real *p;
    sph_vector_out v;
    size_t stride;                    /* of p */
    SPH_GLOBAL unsigned char *status; /* may be null */
} sph_wall_out;

/* Pressure and velocity of wall particles from the fluid in front of them, so that walls push and drag as
   a fluid would. The targets are the wall particles w; the sums run over their neighbours j that are
   fluid (share[j] = 1):
       p_w = sum (p_j + rho_j (g - a_w) . x_wj) W / sum W,
       v_w = 2 u_w - sum v_j W / sum W   for no slip.
   For free slip only the part along the normal is reversed (sph_wall_velocity_free_slip). u_w and a_w are
   the wall's own velocity and acceleration. Adami, Hu & Adams 2012, JCP 231, 7057, (22), (23), (27). A
   pair uses (h_i + h_j) / 2 (lists by SPH_MEAN).
   Without fluid inside the support the answer is p = 0, v = u and SPH_TOO_FEW; such a particle pushes
   nothing. Returns the number of targets that are not SPH_OK, or a negative sph_error. */
SPH_FN sph_index sph_wall_adami(sph_kernel k, int dim, sph_cloud cloud, sph_wall wall, sph_wall_out out)
{
    const sph_scalars share = wall.share, rho = wall.rho, p = wall.p;
    const sph_vectors v = wall.v, wall_velocity = wall.velocity, normal = wall.normal;
    int error = sphi_check_sweep(k, dim, cloud, "share", share);
    const int free_slip = normal.x.p != 0;
    sph_index i, q, failed = 0;
    if (!error) error = sphi_check_field("rho", rho, cloud.points.n);
    if (!error) error = sphi_check_field("p", p, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error) error = sphi_check_vectors("velocity", dim, wall_velocity, cloud.last);
    if (!error && free_slip) error = sphi_check_vectors("normal", dim, normal, cloud.last);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_out("out.v", dim, out.v);
    if (!error && !sphi_finite(sph_dot(dim, wall.gravity, wall.gravity)))
        error = sphi_refuse("wall.gravity", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), u = sphi_vector_at(dim, wall_velocity, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real weight = SPH_R(0), pressure = SPH_R(0), vx = SPH_R(0), vy = SPH_R(0), vz = SPH_R(0);
        sph_wall_sums sums;
        sph_vec answer = u;
        int state = SPH_OK;
        SPH_SUM(q, cloud.list.start[i], cloud.list.start[i + 1], weight, pressure, vx, vy, vz) {
            const sph_index j = cloud.list.index[q];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          v_j = sphi_vector_at(dim, v, j);
            const sph_real w = sphi_at(share, j) *
                               sph_kernel_w(k, dim, sph_length(dim, x_ij), sphi_mean_h(0, cloud.h, h_i, j));
            sph_fluid_side other;
            sph_wall_sums c;
            other.m = other.mu = SPH_R(0);
            other.rho = sphi_at(rho, j);
            other.p = sphi_at(p, j);
            c = sph_wall_pair_adami(dim, other, v_j, x_ij, wall.gravity, w);
            weight += c.weight;
            pressure += c.p;
            vx += c.v.x;
            if (dim > 1) vy += c.v.y;
            if (dim > 2) vz += c.v.z;
        }
        sums.weight = weight;
        sums.p = pressure;
        sums.v.x = vx;
        sums.v.y = vy;
        sums.v.z = vz;
        pressure = SPH_R(0);
        if (!(weight > SPH_R(0))) state = SPH_TOO_FEW;
        else {
            const sph_vec mean = sph_wall_fluid_velocity(sums);
            pressure = sph_wall_pressure(sums);
            answer = free_slip ? sph_wall_velocity_free_slip(dim, mean, u, sphi_vector_at(dim, normal, i))
                               : sph_wall_velocity_no_slip(dim, mean, u);
        }
        if (sphi_put(out.p, sphi_stride(out.stride), i, pressure) | sphi_store_vector(dim, out.v, i, answer))
            state = SPH_NOT_FINITE;
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* Scans what the rows of walls read: share and gravity, and rho of n particles. */
SPH_FN int sphi_check_wall_rows(int dim, sph_cloud cloud, sph_wall wall, sph_index n,
                                SPH_GLOBAL sph_real *row, sph_scalar_out source)
{
    int error = sphi_check_field("share", wall.share, cloud.points.n);
    if (!error) error = sphi_check_field("rho", wall.rho, n);
    if (!error && !row) error = sphi_refuse("row", -1, SPH_ERROR_NULL);
    if (!error && !source.p) error = sphi_refuse("source", -1, SPH_ERROR_NULL);
    if (!error && !sphi_finite(sph_dot(dim, wall.gravity, wall.gravity)))
        error = sphi_refuse("wall.gravity", -1, SPH_ERROR_VALUE);
    return error;
}
/* What j adds to the sums of a wall particle if its pressure is not known yet: p is then that of gravity. */
SPH_FN sph_wall_sums sphi_wall_pair_unknown(int dim, sph_real rho_j, sph_vec x_ij, sph_vec gravity,
                                            sph_real w)
{
    const sph_vec none = {SPH_R(0), SPH_R(0), SPH_R(0)};
    sph_fluid_side other;
    other.m = other.mu = other.p = SPH_R(0);
    other.rho = rho_j;
    return sph_wall_pair_adami(dim, other, none, x_ij, gravity, w);
}

SPH_FN sph_index sphi_wall_rows_range(int uniform, sph_kernel k, int dim, sph_cloud cloud,
                                      const sph_wall *wall, sph_rows_out out, sph_scalar_out source)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT row = out.row;
    sph_index i, q, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_index end = cloud.list.start[i + 1];
        sph_real weight = SPH_R(0), pressure = SPH_R(0);
        sph_wall_sums sums;
        int state = SPH_OK;
        SPH_SUM(q, cloud.list.start[i], end, weight, pressure) {
            const sph_index j = cloud.list.index[q];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_real w = sphi_at(wall->share, j) * sph_kernel_w(k, dim, sph_length(dim, x_ij),
                                                                      sphi_mean_h(uniform, cloud.h, h_i, j));
            const sph_wall_sums c =
                sphi_wall_pair_unknown(dim, sphi_at(wall->rho, j), x_ij, wall->gravity, w);
            row[q] = w;
            weight += c.weight;
            pressure += c.p;
        }
        sums.weight = weight;
        sums.p = pressure;
        sums.v.x = sums.v.y = sums.v.z = SPH_R(0);
        if (!(weight > SPH_R(0))) state = SPH_TOO_FEW;
        else {
            SPH_EACH(q, cloud.list.start[i], end) row[q] = sph_wall_row_weight(row[q], sums);
            pressure = sph_wall_pressure(sums);
            if (sphi_row_finite(row, cloud.list.start[i], end) || !sphi_finite(pressure))
                state = SPH_NOT_FINITE;
        }
        for (q = cloud.list.start[i]; state && q < end; q++) row[q] = SPH_R(0);
        source.p[(size_t)i * sphi_stride(source.stride)] = state ? SPH_R(0) : pressure;
        sphi_put(out.diagonal, sphi_stride(out.stride), i, SPH_R(1));
        sphi_row_answer(out, cloud.list, i, 0, SPH_R(1), state);
        failed += state != SPH_OK;
    }
    return failed;
}

/* The pressure of sph_wall_adami as rows of a matrix for pressures that are not known yet (projection). The
   targets are the wall particles w:
       p_w - sum p_j W / sum W = sum rho_j (g - a_w) . x_wj W / sum W,
   row[p] = -W / sum W for neighbours that are fluid and 0 for others, diagonal = 1, and the right-hand side
   is source. These rows are exact where p - rho g . x is constant, thus for fluid at rest. Of wall, share,
   rho and gravity are read. Without fluid inside the support the row is p_w = 0, with SPH_TOO_FEW. A pair
   uses (h_i + h_j) / 2 (lists by SPH_MEAN). Adami, Hu & Adams 2012, JCP 231, 7057, (27). The status of out is
   written, that of source is not. Returns the number of targets that are not SPH_OK, or a negative sph_error.
   */
SPH_FN sph_index sph_wall_rows_adami(sph_kernel k, int dim, sph_cloud cloud, sph_wall wall, sph_rows_out out,
                                     sph_scalar_out source)
{
    int error = sphi_check_sweep(k, dim, cloud, "share", wall.share);
    if (!error) error = sphi_check_wall_rows(dim, cloud, wall, cloud.points.n, out.row, source);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_wall_rows_range(0, k, dim, cloud, &wall, out, source)
                          : sphi_wall_rows_range(1, k, dim, cloud, &wall, out, source);
}

/* Takes the unknowns of the wall out of the rows of the fluid, sum_p row[p] (p_j - p_i) = b_i. The pressure
   of each wall neighbour w (share = 0) is that of the condition at the wall, dp/dn = rho (g - a_w) . n, from
   the particle i itself: p_w = p_i + rho_i (g - a_w) . x_wi, the formula of sph_wall_adami for i alone. So
       sum over fluid of row[p] (p_j - p_i) = b_i + source_i, source_i = -sum over wall of row[p] (p_w - p_i).
   rows.row is read and written: entries of wall neighbours become 0. rows.diagonal, if it is there, becomes
   -sum_p row[p] again. rows.factor, conditioning and status stay as they are. Exact for fluid at rest, if the
   rows are exact for linear fields; the signs of the rows, and so their monotony, are kept. Any other
   condition dp/dn is passed as gravity with rho = 1. Of wall, share, rho and gravity are read. A row whose
   result is not finite becomes 0. rho is of the targets. Returns the number of such rows, or a negative
   sph_error. */
SPH_FN sph_index sph_wall_rows_eliminate(int dim, sph_cloud cloud, sph_wall wall, sph_rows_out rows,
                                         sph_scalar_out source)
{
    SPH_GLOBAL sph_real *const row = rows.row;
    int error = sphi_check_list(dim, cloud, SPH_R(0));
    sph_index i, q, failed = 0;
    if (!error) error = sphi_check_wall_rows(dim, cloud, wall, cloud.last, row, source);
    if (!error) error = sphi_check_rows(cloud, row, sph_scalars_none());
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real rho_i = sphi_at(wall.rho, i);
        sph_real sum = SPH_R(0), diagonal = SPH_R(0);
        int lost;
        for (q = cloud.list.start[i]; q < cloud.list.start[i + 1]; q++) {
            const sph_index j = cloud.list.index[q];
            if (sphi_at(wall.share, j) == SPH_R(0)) {
                const sph_vec x_ji =
                    sphi_separation(dim, cloud.points, sphi_point(dim, cloud.points, j), x_i);
                sum -= sphi_wall_pair_unknown(dim, rho_i, x_ji, wall.gravity, row[q]).p;
                row[q] = SPH_R(0);
            } else diagonal -= row[q];
        }
        lost = !sphi_finite(sum) || !sphi_finite(diagonal);
        for (q = cloud.list.start[i]; lost && q < cloud.list.start[i + 1]; q++) row[q] = SPH_R(0);
        sphi_put(rows.diagonal, sphi_stride(rows.stride), i, lost ? SPH_R(0) : diagonal);
        failed += sphi_answer(source, i, lost ? SPH_R(0) : sum, lost ? (int)SPH_NOT_FINITE : (int)SPH_OK);
    }
    return failed;
}

/* ================================================================ liquids
 *
 * What weakly compressible liquids need beside their forces. With a density diffusion D_i, the continuity
 * equation of a particle is
 *     drho_i/dt = rho_i sum_j V_j v_ij . grad_i W_ij + D_i,
 *     D_i       = delta c sum_j h_ij psi_ij V_j (-F_ij),
 * and psi_ij is
 *     Molteni & Colagrossi   2 (rho_j - rho_i)
 *     Antuono et al.         2 (rho_j - rho_i) + (g_i + g_j) . x_ij,   g = grad rho by sph_gradient_cspm
 *     Fourtakas et al.       2 (rho_j - rho_i - rho0 gravity . (x_j - x_i) / c^2)
 * D takes away the checkerboard of the density, and with it the noise of the pressure. psi_ij = -psi_ji, so
 * that sum_i V_i D_i = 0 to round-off: no volume-weighted mass comes or goes. In its place many codes print
 * psi r_ji . grad W / (r^2 + eta^2 h^2): the same with eta = 0, since r^2 cancels; eta = 0.1 makes D about
 * 1 % smaller. delta = 0.1 is usual. Some codes call the whole support h, and some leave the 2 of psi to
 * delta: compare the whole factor.
 *
 * Which one: Molteni's is the cheapest, but takes the weight of a column for noise, so that a column at rest
 * sinks (its centre by 0.5 % of the depth within 10 sqrt(depth / gravity)). Antuono's and Fourtakas's do not:
 * less than 0.05 %. Antuono's needs the gradient of the density, one sweep more, but no gravity. All make the
 * noise of the pressure in Taylor-Green vortices seven times weaker (tests/test_liquid_flow.c). Where a wall
 * is made of particles, give them the share 0: otherwise they take density from the liquid. With one h for
 * all, Molteni's adds 5 to 7 % to the time of the rates of a fluid, and Antuono's 20 to 26 %, because it
 * reads four more arrays (tests/bench/README.md).
 *
 * Sources: Molteni & Colagrossi 2009, Comput. Phys. Commun. 180, 861; Antuono, Colagrossi, Marrone & Molteni
 * 2010, Comput. Phys. Commun. 181, 532; Fourtakas, Vacondio, Dominguez & Rogers 2019, Comput. Fluids 190,
 * 346.
 */

/* -------- density diffusion: pair functions */

/* psi = 2 (rho_j - rho_i) of Molteni & Colagrossi: twice the difference of the densities. */
SPH_FN sph_real sph_density_difference_molteni(sph_fluid_side i, sph_fluid_side j)
{
    return SPH_R(2) * (j.rho - i.rho);
}
/* psi = 2 (rho_j - rho_i) + (g_i + g_j) . x_ij of Antuono et al., where g is the gradient of the density at
   the two particles. It is 0 for a linear density, if g is exact. Papers print - (g_i + g_j) . r_ji with
   r_ji = -x_ij. */
SPH_FN sph_real sph_density_difference_antuono(int dim, sph_fluid_side i, sph_fluid_side j, sph_vec g_i,
                                               sph_vec g_j, sph_vec x_ij)
{
    return sph_density_difference_molteni(i, j) + sph_dot(dim, g_i, x_ij) + sph_dot(dim, g_j, x_ij);
}
/* psi = 2 (rho_j - rho_i - slope . (x_j - x_i)) of Fourtakas et al., with slope = rho0 gravity / c^2
   (sph_density_slope). It is 0 for a density of this slope. In its place the paper subtracts
   rho0 (1 + gamma gravity . (x_j - x_i) / c^2)^(1 / gamma) - rho0, which is the same to first order. But that
   does not change its sign with the pair unless gamma = 1, so that it does not conserve. */
SPH_FN sph_real sph_density_difference_fourtakas(int dim, sph_fluid_side i, sph_fluid_side j, sph_vec slope,
                                                 sph_vec x_ij)
{
    return sph_density_difference_molteni(i, j) + SPH_R(2) * sph_dot(dim, slope, x_ij);
}
/* grad rho = rho0 gravity / c^2 in a liquid at rest, near rho0. Needs rho0 > 0 and c > 0. */
SPH_FN sph_vec sph_density_slope(sph_tait t, sph_vec gravity)
{
    SPH_ASSERT(t.rho0 > SPH_R(0) && t.c > SPH_R(0));
    return sph_scale(t.rho0 / (t.c * t.c), gravity);
}
/* The weight of psi: delta c h V_j (-F) >= 0. strength = delta c h, and f_ij = F_ij with the h of the pair.
   */
SPH_FN sph_real sph_density_diffusion_weight(sph_real V_j, sph_real strength, sph_real f_ij)
{
    return -strength * f_ij * V_j;
}
/* The longest step in which density diffusion makes no new extreme: h / (S delta c), with
   S = h^2 sum_j 2 V_j |F_ij| in the limit of many neighbours. In 2D S = 4 pi h^2 W(0), 7 for the C2 kernel of
   Wendland. Twice that step is the limit of stability. With delta = 0.1 it is longer than that of sound
   (sph_time_step_sound). Where nothing limits the step the answer is 1/SPHI_TINY. Needs h > 0, delta >= 0 and
   c >= 0. */
SPH_FN sph_real sph_time_step_density_diffusion(sph_kernel k, int dim, sph_real h, sph_real delta, sph_real c)
{
    const sph_real dq = sph_kernel_support_ratio(k) / SPH_R(64);
    sph_real sum = SPH_R(0);
    int n;
    SPH_ASSERT(SPHI_IS_DIM(dim) && h > SPH_R(0) && delta >= SPH_R(0) && c >= SPH_R(0));
    for (n = 0; n < 64; n++) {
        const sph_real q = dq * (SPH_R(n) + SPH_R(0.5));
        sum -= (dim == 1 ? SPH_R(1) : dim == 2 ? q : q * q) * sph_kernel_shape_f(k, dim, q);
    }
    sum *= SPH_R(2) * dq * sph_kernel_sigma(k, dim) *
           (dim == 1   ? SPH_R(2)
            : dim == 2 ? SPH_R(6.28318530717958647693)
                       : SPH_R(12.5663706143591729539));
    return sphi_limit(h, sum * delta * c);
}

/* -------- density diffusion: sweeps */

/* What density diffusion needs to know. */
typedef struct sph_diffusion {
    sph_fluid fluid; /* rho is read, and v; where v is null there is no density rate beside the diffusion */
    sph_real delta;  /* its strength; 0 means the usual 0.1, a negative number none */
    sph_tait tait;   /* of the liquid: c >= 0 is read, and by fourtakas rho0 */
    /* A pair has the factor share_i share_j: 1 for the liquid, 0 for walls and other fluids. Null: all take
       part. */
    sph_scalars share;
    sph_vectors gradient; /* of the density, from sph_gradient_cspm: antuono only */
    sph_vec gravity;      /* fourtakas only */
} sph_diffusion;

enum { SPHI_MOLTENI, SPHI_ANTUONO, SPHI_FOURTAKAS };
/* The delta of sph_diffusion as it is used. */
SPH_FN sph_real sphi_delta(sph_real delta)
{
    return delta == SPH_R(0) ? SPH_R(0.1) : delta < SPH_R(0) ? SPH_R(0) : delta;
}
SPH_FN int sphi_check_diffusion(int form, sph_kernel k, int dim, sph_cloud cloud, sph_diffusion d)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error && (!sphi_finite(d.delta) || !sphi_finite(d.tait.c) || d.tait.c < SPH_R(0)))
        error = sphi_refuse("diffusion.delta, tait", -1, SPH_ERROR_VALUE);
    if (!error && form == SPHI_FOURTAKAS &&
        (!(d.tait.rho0 > SPH_R(0)) || !(d.tait.c > SPH_R(0)) ||
         !sphi_finite(sph_length(dim, sph_density_slope(d.tait, d.gravity)))))
        error = sphi_refuse("diffusion.tait, gravity", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_positive("rho", d.fluid.rho, cloud.points.n);
    if (!error && d.share.p) error = sphi_check_field("share", d.share, cloud.points.n);
    if (!error && form == SPHI_ANTUONO)
        error = sphi_check_vectors("gradient", dim, d.gradient, cloud.points.n);
    return error;
}
SPH_FN sph_real sphi_density_difference(int form, int dim, sph_fluid_side i, sph_fluid_side j,
                                        const sph_diffusion *d, sph_vec g_i, sph_index at, sph_vec x_ij)
{
    if (form == SPHI_MOLTENI) return sph_density_difference_molteni(i, j);
    if (form == SPHI_FOURTAKAS) return sph_density_difference_fourtakas(dim, i, j, g_i, x_ij);
    return sph_density_difference_antuono(dim, i, j, g_i, sphi_vector_at(dim, d->gradient, at), x_ij);
}
/* moving and shared: whether there are velocities, and shares. They are arguments because the loops
   vectorise only where the compiler knows which arrays are read. */
SPH_FN sph_index sphi_diffusion_range(int form, int uniform, int moving, int shared, sph_kernel k, int dim,
                                      sph_cloud cloud, const sph_diffusion *d, sph_scalar_out out)
{
    const sph_fluid *const f = &d->fluid;
    const sph_real speed = sphi_delta(d->delta) * d->tait.c;
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i),
                      v_i = moving ? sphi_vector_at(dim, f->v, i) : sph_scale(SPH_R(0), x_i),
                      g_i = form == SPHI_ANTUONO     ? sphi_vector_at(dim, d->gradient, i)
                            : form == SPHI_FOURTAKAS ? sph_density_slope(d->tait, d->gravity)
                                                     : v_i;
        const sph_real h_i = sphi_at(cloud.h, i), speed_i = shared ? speed * sphi_at(d->share, i) : speed;
        const sph_fluid_side own = sphi_fluid_side(SPHI_READ_RHO, f, f->rho, i);
        sph_real rate = SPH_R(0);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], rate) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_fluid_side other = sphi_fluid_side(SPHI_READ_RHO, f, f->rho, j);
            const sph_real V_j = sphi_at(cloud.volume, j), h_ij = sphi_mean_h(uniform, cloud.h, h_i, j),
                           f_ij = sph_kernel_f(k, dim, sph_length(dim, x_ij), h_ij),
                           strength = h_ij * (shared ? speed_i * sphi_at(d->share, j) : speed_i);
            sph_real c = sph_density_diffusion_weight(V_j, strength, f_ij) *
                         sphi_density_difference(form, dim, own, other, d, g_i, j, x_ij);
            if (moving) { /* a volume is a mass of density 1 */
                sph_fluid_side unit = other;
                unit.m = V_j;
                unit.rho = SPH_R(1);
                c += sph_density_rate_pair_volume(
                    own, unit, sph_dot(dim, sph_subtract(dim, v_i, sphi_vector_at(dim, f->v, j)), x_ij),
                    f_ij);
            }
            rate += c;
        }
        failed += sphi_store(out, i, rate);
    }
    return failed;
}
SPH_FN sph_index sphi_diffusion_shares(int form, int uniform, int moving, sph_kernel k, int dim,
                                       sph_cloud cloud, const sph_diffusion *d, sph_scalar_out out)
{
    return d->share.p ? sphi_diffusion_range(form, uniform, moving, 1, k, dim, cloud, d, out)
                      : sphi_diffusion_range(form, uniform, moving, 0, k, dim, cloud, d, out);
}
SPH_FN sph_index sphi_diffusion(int form, sph_kernel k, int dim, sph_cloud cloud, sph_diffusion d,
                                sph_scalar_out out)
{
    const int moving = d.fluid.v.x.p != 0;
    int error = sphi_check_diffusion(form, k, dim, cloud, d);
    if (!error && moving) error = sphi_check_vectors("v", dim, d.fluid.v, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    if (cloud.h.stride)
        return moving ? sphi_diffusion_shares(form, 0, 1, k, dim, cloud, &d, out)
                      : sphi_diffusion_shares(form, 0, 0, k, dim, cloud, &d, out);
    return moving ? sphi_diffusion_shares(form, 1, 1, k, dim, cloud, &d, out)
                  : sphi_diffusion_shares(form, 1, 0, k, dim, cloud, &d, out);
}

/* drho_i/dt = rho_i sum_j V_j v_ij . grad_i W_ij + D_i: the density rate of the liquid with the density
   diffusion of Molteni & Colagrossi. V is the volume of the cloud, m / rho of the same moment. Where
   diffusion.fluid.v is null, the answer is D_i alone. Take the new velocities, as the order of a step in the
   chapter of fluids says. A pair uses (h_i + h_j) / 2: lists by SPH_MEAN, or by any criterion if all
   particles have the same h.
     D      is delta c h times sph_laplacian_brookshaw of the density, if all have the same h. It conserves
            sum_i V_i rho_i to round-off, and is dissipative: sum_i V_i rho_i D_i <= 0. It is 0 for
            constants only: it takes the density of a column at rest for noise.
   Across a jump of rho0 diffuse rho / rho0 instead, or give the other fluid the share 0. Where the sum
   overflows, the result is 0 and SPH_NOT_FINITE. Returns the number of these targets, or a negative
   sph_error. Sources stand at the head of the chapter. */
SPH_FN sph_index sph_density_diffusion_molteni(sph_kernel k, int dim, sph_cloud cloud,
                                               sph_diffusion diffusion, sph_scalar_out out)
{
    return sphi_diffusion(SPHI_MOLTENI, k, dim, cloud, diffusion, out);
}
/* The same with the density diffusion of Antuono et al. (delta-SPH): D = 0 to round-off for a linear density
   at any particle, also at a boundary, if diffusion.gradient comes from sph_gradient_cspm. */
SPH_FN sph_index sph_density_diffusion_antuono(sph_kernel k, int dim, sph_cloud cloud,
                                               sph_diffusion diffusion, sph_scalar_out out)
{
    return sphi_diffusion(SPHI_ANTUONO, k, dim, cloud, diffusion, out);
}
/* The same with the density diffusion of Fourtakas et al.: D = 0 to round-off for a density of the slope
   rho0 gravity / c^2 (sph_density_slope) at any particle. */
SPH_FN sph_index sph_density_diffusion_fourtakas(sph_kernel k, int dim, sph_cloud cloud,
                                                 sph_diffusion diffusion, sph_scalar_out out)
{
    return sphi_diffusion(SPHI_FOURTAKAS, k, dim, cloud, diffusion, out);
}
SPH_FN sph_index sphi_diffusion_rows_range(int uniform, sph_kernel k, int dim, sph_cloud cloud,
                                           const sph_diffusion *d, sph_rows_out out)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT row = out.row;
    const int shared = d->share.p != 0;
    const sph_real speed = sphi_delta(d->delta) * d->tait.c;
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), speed_i = shared ? speed * sphi_at(d->share, i) : speed;
        int lost;
        SPH_EACH(p, cloud.list.start[i], cloud.list.start[i + 1]) {
            const sph_index j = cloud.list.index[p];
            const sph_real r = sph_length(dim, sphi_separation(dim, cloud.points, x_i,
                                                               sphi_point(dim, cloud.points, j))),
                           h_ij = sphi_mean_h(uniform, cloud.h, h_i, j),
                           strength = h_ij * (shared ? speed_i * sphi_at(d->share, j) : speed_i);
            row[p] = SPH_R(2) * sph_density_diffusion_weight(sphi_at(cloud.volume, j), strength,
                                                             sph_kernel_f(k, dim, r, h_ij));
        }
        lost = sphi_row_finite(row, cloud.list.start[i], cloud.list.start[i + 1]);
        sphi_row_answer(out, cloud.list, i, 1, SPH_R(1), lost ? (int)SPH_NOT_FINITE : (int)SPH_OK);
        failed += lost;
    }
    return failed;
}

/* The D of Molteni & Colagrossi as rows: D_i = sum_p row[p] (rho_j - rho_i), row[p] >= 0, factor 1 and
   conditioning 1. The rates of sph_density_diffusion_molteni without v agree to round-off. A row that
   overflows is 0, with SPH_NOT_FINITE. */
SPH_FN sph_index sph_density_diffusion_rows_molteni(sph_kernel k, int dim, sph_cloud cloud,
                                                    sph_diffusion diffusion, sph_rows_out out)
{
    int error = sphi_check_diffusion(SPHI_MOLTENI, k, dim, cloud, diffusion);
    if (!error && !out.row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_diffusion_rows_range(0, k, dim, cloud, &diffusion, out)
                          : sphi_diffusion_rows_range(1, k, dim, cloud, &diffusion, out);
}

/* The least eigenvalue of a symmetric tensor s: in 3D by the cosine of a third of an angle, in a quarter of
   the time that sph_sym_eigenvalues takes. Its error is about sqrt(epsilon) of the largest where the two
   least ones are equal, else rounding error. Smith 1961, Commun. ACM 4, 168. */
SPH_FN sph_real sph_sym_least_eigenvalue(int dim, sph_sym s)
{
    const sph_real mean = (s.xx + s.yy + s.zz) / SPH_R(3);
    sph_real spread, angle;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    if (dim < 3) return sph_sym_eigenvalues(dim, s).x;
    s.xx -= mean;
    s.yy -= mean;
    s.zz -= mean;
    spread = SPHI_SQRT(
        (s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + SPH_R(2) * (s.xy * s.xy + s.xz * s.xz + s.yz * s.yz)) /
        SPH_R(6));
    if (!(spread > SPH_EPSILON * SPHI_ABS(mean))) return mean - spread;
    angle = (s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.xz) +
             s.xz * (s.xy * s.yz - s.yy * s.xz)) /
            (SPH_R(2) * spread * spread * spread);
    angle = angle > SPH_R(1) ? SPH_R(1) : angle < SPH_R(-1) ? SPH_R(-1) : angle;
    angle = (SPHI_ACOS(angle) + SPH_R(6.28318530717958647693)) / SPH_R(3);
    return mean + SPH_R(2) * spread * SPHI_COS(angle);
}

/* -------- free surface: functions of values
 *
 * One pass over the neighbours, with e = x_j - x_i and the weight -V_j F_ij of CSPM's gradient, gives
 *     K        = sum_j weight e e^T,   the unit tensor inside,
 *     div r    = tr K:                 dim inside; at a surface less than 1.5 (2D) or 2.4 (3D),
 *     lambda   = the least eigenvalue of K: 1 inside, 0 for a particle alone,
 *     normal   = -K^-1 g / |K^-1 g|,   outward, where g = sum_j V_j grad_i W_ij points inward.
 * lambda < 0.75 marks a band of one to two rows. That is what shifting needs. In it the cone finds the one
 * row that is the surface. That is what a condition p = 0 needs: of particles that are moved by up to 0.3
 * spacings it finds more than 99 %, with less than 0.5 % of others (tests/test_liquid.c). div r is nearly as
 * good for h = 1.3 spacings, less for longer ones, and costs no second pass. Sums of V W tell a surface from
 * disorder badly, and are not offered. Wall particles must be sources with their volume: otherwise the liquid
 * has a surface there.
 *
 * Sources: Marrone, Colagrossi, Le Touze & Graziani 2010, JCP 229, 3652 (lambda, cone); Lee, Moulinec, Xu,
 * Violeau, Laurence & Stansby 2008, JCP 227, 8417 (div r; their formula has the wrong sign).
 */

/* What lambda says of a particle. */
typedef enum sph_surface {
    SPH_SURFACE_INSIDE, /* lambda > 0.75 */
    SPH_SURFACE_BAND,   /* look closer */
    SPH_SURFACE_SPLASH  /* lambda < 0.2: at the surface, or outside */
} sph_surface;
/* INSIDE for lambda > 0.75, SPLASH for lambda < 0.2, BAND between. lambda comes from sph_free_surface.
   Marrone et al. 2010, JCP 229, 3652. */
SPH_FN sph_surface sph_surface_of(sph_real lambda)
{
    if (lambda < SPH_R(0.2)) return SPH_SURFACE_SPLASH;
    return lambda > SPH_R(0.75) ? SPH_SURFACE_INSIDE : SPH_SURFACE_BAND;
}
/* The outward normal -K^-1 g / |K^-1 g|; inverse = K^-1 (sph_solve_gradient), g = sum_j V_j grad_i W_ij. It
   is 0 where |K^-1 g| h is rounding error, as inside a lattice. Needs h > 0. */
SPH_FN sph_vec sph_surface_normal(int dim, sph_sym inverse, sph_vec g, sph_real h)
{
    const sph_vec a = sphi_sym_times(dim, inverse, g);
    const sph_real length = sph_length(dim, a);
    SPH_ASSERT(h > SPH_R(0));
    return sph_scale(length * h > SPHI_PIVOT_MIN ? SPH_R(-1) / length : SPH_R(0), a);
}
/* 1 if the neighbour j covers i, so that i is not at the surface: if j lies
       within sqrt(2) h of i, less than 45 degrees from the normal, or
       farther away, but within h of the point x_i + h normal.
   x_ij = x_i - x_j. The same in all dimensions: in 2D the first region is the part within sqrt(2) h of the
   square that Marrone et al. print. A coincident j covers nothing. Needs h > 0. */
SPH_FN int sph_surface_covers(int dim, sph_vec normal, sph_vec x_ij, sph_real h)
{
    const sph_real r2 = sph_dot(dim, x_ij, x_ij), up = -sph_dot(dim, normal, x_ij);
    SPH_ASSERT(h > SPH_R(0));
    if (r2 < SPH_R(2) * h * h) return up > SPH_R(0) && SPH_R(2) * up * up > r2;
    return r2 - SPH_R(2) * h * up < SPH_R(0); /* |x_ij + h n|^2 < h^2 */
}

/* -------- free surface: sweeps */

/* Where what is known of the surface goes. divergence, lambda and status may be null. The stride is that of
   divergence and lambda. */
typedef struct sph_surface_out {
    SPH_GLOBAL sph_real *divergence, *eigenvalue; /* div r and lambda, pure numbers */
    sph_vector_out normal;                        /* outward, of length 1 or 0 */
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_surface_out;

/* div r, lambda and the normal of the targets, in one pass. A target needs neighbours as for
   sph_gradient_cspm. Else it is SPH_TOO_FEW or SPH_SINGULAR, with the normal 0; div r and lambda are computed
   (without neighbours they are 0). The normal is also 0 where no side is emptier than another. On a disc
   of particles that are moved by up to 0.3 spacings it is off by 8 degrees in the mean for h = 1.33 spacings,
   and by 3 degrees for h = 2. Returns the number of targets that are not SPH_OK, or a negative sph_error. */
SPH_FN sph_index sph_free_surface(sph_kernel k, int dim, sph_cloud cloud, sph_surface_out out)
{
    const size_t stride = sphi_stride(out.stride);
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_out("out.normal", dim, out.normal);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_sym moment, inverse;
        sph_vec g, normal;
        sph_real trace;
        int state, lost;
        sphi_gradient_moments(SPHI_BY_CSPM, k, dim, i, cloud.points, cloud.list, h_i, cloud.volume, 2,
                              cloud.volume, &moment, &g);
        normal = sph_scale(SPH_R(0), g);
        state = sph_solve_gradient(dim, moment, &inverse, 0);
        if (state) state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i, dim);
        else normal = sph_surface_normal(dim, inverse, g, h_i);
        trace = moment.xx;
        if (dim > 1) trace += moment.yy;
        if (dim > 2) trace += moment.zz;
        lost = sphi_put(out.divergence, stride, i, trace);
        lost |= sphi_put(out.eigenvalue, stride, i, sph_sym_least_eigenvalue(dim, moment));
        lost |= sphi_store_vector(dim, out.normal, i, normal);
        if (lost) state = SPH_NOT_FINITE;
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}
/* flag[i] = 1 for the targets at the surface, else 0, from the eigenvalue lambda and the normal of the
   targets by sph_free_surface. Only the band of sph_surface_of is scanned, until a neighbour covers the
   target (sph_surface_covers). In the band, a target without a normal is at the surface. h is that of the
   target; lists must hold every source with r < 2 h. Returns the number of targets at the surface, or a
   negative sph_error. */
SPH_FN sph_index sph_free_surface_cone(int dim, sph_cloud cloud, sph_scalars eigenvalue, sph_vectors normal,
                                       SPH_GLOBAL unsigned char *flag)
{
    /* any kernel that ends at 2 h checks what this sweep needs */
    int error = sphi_check_weights(SPH_WENDLAND_C2, dim, cloud, "eigenvalue", eigenvalue, cloud.last);
    sph_index i, p, found = 0;
    if (!error) error = sphi_check_vectors("normal", dim, normal, cloud.last);
    if (!error && !flag) error = sphi_refuse("flag", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), n_i = sphi_vector_at(dim, normal, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_surface kind = sph_surface_of(sphi_at(eigenvalue, i));
        int covered = kind == SPH_SURFACE_INSIDE;
        for (p = cloud.list.start[i]; kind == SPH_SURFACE_BAND && !covered && p < cloud.list.start[i + 1];
             p++)
            covered = sph_surface_covers(
                dim, n_i,
                sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, cloud.list.index[p])),
                h_i);
        flag[i] = (unsigned char)!covered;
        found += !covered;
    }
    return found;
}

/* -------- shifting: functions of values
 *
 * Particles that follow the flow line up and leave holes. Shifting moves them a little from where they are
 * many to where they are few, along
 *     G_i  = sum_j V_j (1 + R (W_ij / W(dx))^4) grad_i W_ij,   dx_i = -strength_i G_i.
 * Inside an even cloud G is 0; at a free surface it points inward, so that dx would throw particles out:
 * sph_shift_at_surface keeps there only what lies along the surface. strength is an area:
 *     Lind et al.    A h^2 with A <= 0.5,
 *     Skillen et al. A h |v| dt with A = 1 ... 6 (sph_shift_strength_skillen),
 *     Sun et al.     dt v_max (2 h)^2 / (2 length) (sph_shift_strength_sun); they take R = 0.2, and
 *                    m_j / (rho_i + rho_j) where V_j / 2 stands here.
 * What a particle carries moves with it. Add dx . grad f to each field f (sph_gradient_cspm: exact for linear
 * fields), or the rates of sph_shift_rates. Or move particles with the transport velocity
 * (sph_transport_adami).
 *
 * WHAT IT COSTS. Shifting keeps particles even: with density diffusion the velocity of coarse Taylor-Green
 * vortices is off by 3 % instead of 22 %. But it does not conserve angular momentum, and makes a liquid with
 * a free surface swell: a still tank rises by 1 % to 2 % of its depth in 6 sqrt(depth / gravity) where v_max
 * is a speed that the liquid never has, and hardly where v_max is that of the moment; density diffusion alone
 * leaves it where it is (tests/test_liquid_flow.c asserts all this, of particles that start from a lattice;
 * other starts gave -0.2 % to 0.7 %: examples/fluids/README.md). See also Jandaghian et al. 2021,
 * arXiv:2110.10076. With walls, their particles must be sources.
 *
 * As a tool that packs particles: dx = -0.4 h^2 G, again and again with new lists, makes an even cloud of any
 * one, in any shape whose outside is filled with particles that do not move. It converges for A <= 0.6 and
 * diverges for 1 (Wendland's kernels). examples/OPERATORS.md shows the loop.
 *
 * Sources: Lind, Xu, Stansby & Rogers 2012, JCP 231, 1499; Skillen, Lind, Stansby & Rogers 2013, CMAME 265,
 * 163; Sun, Colagrossi, Marrone & Zhang 2017, CMAME 315, 25; Sun, Colagrossi, Marrone, Antuono & Zhang 2019,
 * CMAME 348, 912; Adami, Hu & Adams 2013, JCP 241, 292; R and the power 4: Monaghan 2000, JCP 159, 290.
 */

/* What j adds to G: V_j (1 + R w^4) F x_ij, with w = W_ij / W(dx), and R = tensile, 0.2 or 0. */
SPH_FN sph_vec sph_shift_pair(sph_real V_j, sph_real f_ij, sph_vec x_ij, sph_real tensile, sph_real w)
{
    return sph_scale(V_j * (SPH_R(1) + tensile * (w * w) * (w * w)) * f_ij, x_ij);
}
/* A h |v| dt of Skillen et al.; factor = A, 1 ... 6, and path = |v| dt. */
SPH_FN sph_real sph_shift_strength_skillen(sph_real factor, sph_real h, sph_real path)
{
    return factor * h * path;
}
/* dt v_max (2 h)^2 / (2 length) of Sun et al.; path = v_max dt with the largest speed of the flow. In the
   paper length = h; TrixiParticles takes 2 dx, because the shift then scales with the spacing. At h = 2 dx
   they are the same. Needs length > 0. */
SPH_FN sph_real sph_shift_strength_sun(sph_real h, sph_real path, sph_real length)
{
    SPH_ASSERT(length > SPH_R(0));
    return SPH_R(2) * path * h * h / length;
}
/* What a free surface leaves of a shift dx: none for lambda < 0.4 (splash), only the part along the surface,
   dx - n (n . dx), for lambda < 0.75, and all of it inside. lambda and the normal n come from
   sph_free_surface. The limits are those of Sun et al. 2019. */
SPH_FN sph_vec sph_shift_at_surface(int dim, sph_vec shift, sph_real lambda, sph_vec normal)
{
    if (lambda < SPH_R(0.4)) return sph_scale(SPH_R(0), shift);
    if (!(lambda < SPH_R(0.75))) return shift;
    return sph_subtract(dim, shift, sph_scale(sph_dot(dim, normal, shift), normal));
}
/* The shift, made shorter if it is longer than `longest`. Needs longest >= 0. */
SPH_FN sph_vec sph_shift_limited(int dim, sph_vec shift, sph_real longest)
{
    const sph_real length = sph_length(dim, shift);
    SPH_ASSERT(longest >= SPH_R(0));
    return length > longest ? sph_scale(longest / length, shift) : shift;
}
/* V_j u . grad_i W_ij for the velocities u of shifting of both particles. */
typedef struct sph_shift_along {
    sph_real i, j;
} sph_shift_along;
/* What j adds to the rate of a field f that is seen from a particle with the velocity v + u instead of v, u
   being the velocity of shifting:
       f_i (u_i - u_j) . V_j grad_i W_ij + (f_i u_i + f_j u_j) . V_j grad_i W_ij,
   which are -f div u and div(f u): their sum is u . grad f. Sun et al. 2019. */
SPH_FN sph_real sph_shift_rate_pair(sph_shift_along along, sph_real f_i, sph_real f_j)
{
    return f_i * (along.i - along.j) + (f_i * along.i + f_j * along.j);
}
/* One particle of a pair that moves with a transport velocity u: its mass and density, its velocity v, and
   drift = u - v. */
typedef struct sph_transport_side {
    sph_real m, rho;
    sph_vec v, drift;
} sph_transport_side;
/* What j adds to i: the acceleration by a background pressure of 1, and that by the stress of the drift. */
typedef struct sph_transport_change {
    sph_vec background, stress;
} sph_transport_change;
/* With P_1 = (V_i^2 + V_j^2) / (m_i m_j), which is sph_pressure_pair_hu_adams for p = 1:
       background  -m_j P_1 grad_i W_ij,
       stress      m_j P_1 (A_i + A_j) / 2 . grad_i W_ij,   A = rho v drift^T.
   Adami, Hu & Adams 2013. Needs m > 0 and rho > 0 on both sides. */
SPH_FN sph_transport_change sph_transport_pair_adami(int dim, sph_transport_side i, sph_transport_side j,
                                                     sph_vec x_ij, sph_real f_ij)
{
    sph_fluid_side a, b;
    sph_transport_change c;
    sph_real push, along_i, along_j;
    a.m = i.m;
    a.rho = i.rho;
    b.m = j.m;
    b.rho = j.rho;
    a.p = b.p = SPH_R(1);
    a.mu = b.mu = SPH_R(0);
    push = j.m * sph_pressure_pair_hu_adams(a, b) * f_ij;
    along_i = SPH_R(0.5) * push * i.rho * sph_dot(dim, i.drift, x_ij);
    along_j = SPH_R(0.5) * push * j.rho * sph_dot(dim, j.drift, x_ij);
    c.background = sph_scale(-push, x_ij);
    c.stress.x = along_i * i.v.x + along_j * j.v.x;
    c.stress.y = along_i * i.v.y + along_j * j.v.y;
    c.stress.z = along_i * i.v.z + along_j * j.v.z;
    return c;
}

/* -------- shifting: sweeps */

/* How particles are shifted. Zeros are the defaults where nothing else is said. Arrays are of the targets. */
typedef struct sph_shift {
    sph_scalars strength;   /* an area, of each particle or of all. There is no default */
    sph_real tensile;       /* R; 0: no such term */
    sph_real spacing;       /* dx / h, of the particles as they should lie; is read if R is not 0 */
    sph_scalars eigenvalue; /* lambda of sph_free_surface. Null: there is no free surface */
    sph_vectors normal;     /* of sph_free_surface; is read with lambda */
    sph_real longest;       /* the longest shift, a length; 0 means 0.2 h, a negative number no limit */
} sph_shift;

SPH_FN sph_index sphi_shift_range(int uniform, int tensile, sph_kernel k, int dim, sph_cloud cloud,
                                  const sph_shift *s, sph_vector_out out)
{
    const sph_real per_w = tensile ? SPH_R(1) / sph_kernel_w(k, dim, s->spacing, SPH_R(1)) : SPH_R(0);
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real gx = SPH_R(0), gy = SPH_R(0), gz = SPH_R(0);
        sph_vec shift;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], gx, gy, gz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_real h_ij = sphi_mean_h(uniform, cloud.h, h_i, j);
            const sph_wf both = sph_kernel_wf(k, dim, sph_length(dim, x_ij), h_ij);
            const sph_vec g =
                sph_shift_pair(sphi_at(cloud.volume, j), both.f, x_ij, tensile ? s->tensile : SPH_R(0),
                               tensile ? both.w * sphi_power(h_ij, dim) * per_w : SPH_R(0));
            gx += g.x;
            gy += g.y;
            gz += g.z;
        }
        shift.x = gx;
        shift.y = gy;
        shift.z = gz;
        shift = sph_scale(-sphi_at(s->strength, i), shift);
        if (s->eigenvalue.p)
            shift = sph_shift_at_surface(dim, shift, sphi_at(s->eigenvalue, i),
                                         sphi_vector_at(dim, s->normal, i));
        if (!(s->longest < SPH_R(0)))
            shift = sph_shift_limited(dim, shift, s->longest > SPH_R(0) ? s->longest : SPH_R(0.2) * h_i);
        failed += sphi_store_vector(dim, out, i, shift);
    }
    return failed;
}
/* The shift dx_i = -strength_i G_i of the targets, less what the surface forbids, and no longer than
   `longest`. The host adds it to the positions; for a velocity of shifting it divides by dt (Sun et al. 2019:
   longest = dt v_max / 2). A pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). With the same strength for all,
   no surface and no limit, sum_i V_i dx_i = 0 to round-off. What it costs stands above. Returns the number of
   targets whose shift overflowed (it is 0 then), or a negative sph_error.
   Atlas: keeps the centre of volume. */
SPH_FN sph_index sph_shift_displacement(sph_kernel k, int dim, sph_cloud cloud, sph_shift shift,
                                        sph_vector_out out)
{
    const int tensile = shift.tensile != SPH_R(0);
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_field("strength", shift.strength, cloud.last);
    if (!error && (!sphi_finite(shift.tensile) || !sphi_finite(shift.longest)))
        error = sphi_refuse("shift.tensile, longest", -1, SPH_ERROR_VALUE);
    if (!error && tensile && (!(shift.spacing > SPH_R(0)) || !(shift.spacing < sph_kernel_support_ratio(k))))
        error = sphi_refuse("shift.spacing", -1, SPH_ERROR_VALUE);
    if (!error && shift.eigenvalue.p) {
        error = sphi_check_field("eigenvalue", shift.eigenvalue, cloud.last);
        if (!error) error = sphi_check_vectors("normal", dim, shift.normal, cloud.last);
    }
    if (!error) error = sphi_check_out("out", dim, out);
    if (error) return sphi_answer_of(error);
    if (cloud.h.stride)
        return tensile ? sphi_shift_range(0, 1, k, dim, cloud, &shift, out)
                       : sphi_shift_range(0, 0, k, dim, cloud, &shift, out);
    return tensile ? sphi_shift_range(1, 1, k, dim, cloud, &shift, out)
                   : sphi_shift_range(1, 0, k, dim, cloud, &shift, out);
}

SPH_FN sph_index sphi_shift_rates_range(int uniform, sph_kernel k, int dim, sph_cloud cloud,
                                        const sph_fluid *f, const sph_vectors *shift, sph_fluid_out out)
{
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, f->v, i),
                      u_i = sphi_vector_at(dim, *shift, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_fluid_side own = sphi_fluid_side(SPHI_READ_RHO, f, f->rho, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0), rate = SPH_R(0);
        sph_vec sum;
        int lost;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az, rate) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          v_j = sphi_vector_at(dim, f->v, j);
            const sph_fluid_side other = sphi_fluid_side(SPHI_READ_RHO, f, f->rho, j);
            const sph_vec g =
                sph_gradient_pair_difference(k, dim, sphi_at(cloud.volume, j), SPH_R(1), x_ij,
                                             sph_length(dim, x_ij), sphi_mean_h(uniform, cloud.h, h_i, j));
            sph_shift_along along;
            along.i = sph_dot(dim, u_i, g);
            along.j = sph_dot(dim, sphi_vector_at(dim, *shift, j), g);
            rate += sph_shift_rate_pair(along, own.rho, other.rho);
            ax += sph_shift_rate_pair(along, v_i.x, v_j.x);
            if (dim > 1) ay += sph_shift_rate_pair(along, v_i.y, v_j.y);
            if (dim > 2) az += sph_shift_rate_pair(along, v_i.z, v_j.z);
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        lost = sphi_store_vector(dim, out.acceleration, i, sum);
        lost |= sphi_put(out.rate, sphi_stride(out.stride), i, rate);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}
/* What particles that move with v + u instead of v, where u = shift is a velocity, add to their acceleration
   and density rate: u . grad v and u . grad rho, by sph_shift_rate_pair. Sun et al. 2019. Of fluid, the
   members rho and v are read; out.heating is not written. A pair uses (h_i + h_j) / 2 (lists by SPH_MEAN).
   For a constant f the rate is 2 f u_i . sum_j V_j grad_i W_ij: not 0 in disorder, so that it depends on the
   frame, and momentum is not conserved. (sum_i V_i of the part div(rho u) is 0 to round-off.) u . grad f
   with sph_gradient_cspm is exact for linear f instead, and conserves nothing. Returns the number of targets
   of which a result overflowed (it is 0 then), or a negative sph_error. */
SPH_FN sph_index sph_shift_rates(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid, sph_vectors shift,
                                 sph_fluid_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_positive("rho", fluid.rho, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, fluid.v, cloud.points.n);
    if (!error) error = sphi_check_vectors("shift", dim, shift, cloud.points.n);
    if (!error) error = sphi_check_out("out.acceleration", dim, out.acceleration);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_shift_rates_range(0, k, dim, cloud, &fluid, &shift, out)
                          : sphi_shift_rates_range(1, k, dim, cloud, &fluid, &shift, out);
}

/* Where the accelerations of the transport velocity go. */
typedef struct sph_transport_out {
    sph_vector_out background, stress;
    SPH_GLOBAL unsigned char *status;
} sph_transport_out;

SPH_FN sph_transport_side sphi_transport_side(int dim, const sph_fluid *f, const sph_vectors *transport,
                                              sph_index i)
{
    sph_transport_side s;
    s.m = sphi_at(f->m, i);
    s.rho = sphi_at(f->rho, i);
    s.v = sphi_vector_at(dim, f->v, i);
    s.drift = sph_subtract(dim, sphi_vector_at(dim, *transport, i), s.v);
    return s;
}
SPH_FN sph_index sphi_transport_range(int uniform, sph_kernel k, int dim, sph_cloud cloud, const sph_fluid *f,
                                      const sph_vectors *transport, sph_real background,
                                      sph_transport_out out)
{
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_transport_side own = sphi_transport_side(dim, f, transport, i);
        sph_real bx = SPH_R(0), by = SPH_R(0), bz = SPH_R(0), sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
        sph_vec sum;
        int lost;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], bx, by, bz, sx, sy, sz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_transport_change c = sph_transport_pair_adami(
                dim, own, sphi_transport_side(dim, f, transport, j), x_ij,
                sph_kernel_f_apart(k, dim, sph_length(dim, x_ij), sphi_mean_h(uniform, cloud.h, h_i, j)));
            bx += c.background.x;
            sx += c.stress.x;
            if (dim > 1) by += c.background.y, sy += c.stress.y;
            if (dim > 2) bz += c.background.z, sz += c.stress.z;
        }
        sum.x = background * bx;
        sum.y = background * by;
        sum.z = background * bz;
        lost = sphi_store_vector(dim, out.background, i, sum);
        sum.x = sx;
        sum.y = sy;
        sum.z = sz;
        lost |= sphi_store_vector(dim, out.stress, i, sum);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}
/* The two accelerations of a scheme whose particles move with a transport velocity u, which is nearly v but
   keeps the particles even:
       background  -(p_b / m_i) sum_j (V_i^2 + V_j^2) grad_i W_ij, from the pressure `background` = p_b,
       stress      (1 / m_i) sum_j (V_i^2 + V_j^2) (A_i + A_j) / 2 . grad_i W_ij,   A = rho v (u - v)^T.
   A step: v += dt (a + stress) with the other accelerations a, u = v + dt / 2 background (of a half step),
   x += dt u, and rho from sph_density_summation or sph_density_number. p_b = rho0 c^2 is usual, and the
   pressure in a is then close to 0 (Tait with p0 = 0).
   For flows without a free surface only: a background pressure throws particles out of one. Both conserve
   linear momentum to round-off. Adami, Hu & Adams 2013, JCP 241, 292. Of fluid, the members m, rho and v are
   read. A pair uses (h_i + h_j) / 2 (lists by SPH_MEAN). Pairs closer than 1e-12 h exert no force on each
   other. Returns the number of targets of which a result overflowed (it is 0 then), or a negative
   sph_error. */
SPH_FN sph_index sph_transport_adami(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                     sph_vectors transport, sph_real background, sph_transport_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "m", fluid.m);
    if (!error) error = sphi_check_positive("m", fluid.m, cloud.points.n);
    if (!error) error = sphi_check_positive("rho", fluid.rho, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, fluid.v, cloud.points.n);
    if (!error) error = sphi_check_vectors("transport", dim, transport, cloud.points.n);
    if (!error && !sphi_finite(background)) error = sphi_refuse("background", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_out("out.background", dim, out.background);
    if (!error) error = sphi_check_out("out.stress", dim, out.stress);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_transport_range(0, k, dim, cloud, &fluid, &transport, background, out)
                          : sphi_transport_range(1, k, dim, cloud, &fluid, &transport, background, out);
}

/* -------- divergence-free SPH: functions of values
 *
 * A solver of the pressure that keeps drho_i/dt = 0 (and then rho_i = rho0) without a matrix gives each
 * particle a kappa_i from its own error, changes the velocities by
 *     v_i -= dt sum_j m_j (kappa_i / rho_i + kappa_j / rho_j) grad_i W_ij,
 * and repeats that. kappa_i = alpha_i drho_i/dt / dt, with
 *     alpha_i = rho_i / (|sum_j m_j grad_i W_ij|^2 + m_i sum_j m_j |grad_i W_ij|^2),
 * takes all of the error of i away if no other particle changes its kappa: alpha is the diagonal of the
 * matrix, and the iteration is Jacobi's. Bender & Koschier 2015, Divergence-free smoothed particle
 * hydrodynamics, SCA '15, 147. They have equal masses, m_j^2 in place of m_i m_j: with unequal ones the
 * change above acts on j with m_i, so that only this form takes the error away.
 *
 * WHAT IT CANNOT DO. Particles that correct all at once correct each other, too. With a part w of kappa the
 * passes converge only for w < 2 / L, where L, the largest eigenvalue, grows with the number of neighbours:
 * for wendland-c2 with h = 1.4 spacings it is 2.4, 3.4 and 5.9 in 1D, 2D and 3D (tests/test_liquid.c), so
 * that the whole kappa, w = 1, diverges. At a free surface the density rate is that of a cut support: take
 * errors of compression only, max(drho_i/dt, 0). A particle with hardly any neighbours gets a huge factor:
 * such codes pass over particles with fewer than about 20 of them (3D).
 */

/* What j adds to the sums of alpha. */
typedef struct sph_dfsph_sums {
    sph_vec gradient; /* m_j grad_i W_ij */
    sph_real square;  /* m_j |grad_i W_ij|^2, if j moves */
    SPHI_TCC_PAD
} sph_dfsph_sums;
/* m_j F x_ij and moves_j m_j |F x_ij|^2. moves_j = 1, or 0 for a wall particle that no pressure moves. */
SPH_FN sph_dfsph_sums sph_pressure_factor_pair_dfsph(int dim, sph_real m_j, sph_real moves_j, sph_vec x_ij,
                                                     sph_real f_ij)
{
    sph_dfsph_sums s;
    s.gradient = sph_scale(m_j * f_ij, x_ij);
    s.square = moves_j * f_ij * sph_dot(dim, s.gradient, x_ij);
    return s;
}
/* alpha_i = rho_i / (|s.gradient|^2 + m_i s.square), from the sums. Where nothing pushes, the denominator is
   0 and the answer not finite. */
SPH_FN sph_real sph_pressure_factor_value_dfsph(int dim, sph_fluid_side i, sph_dfsph_sums s)
{
    return i.rho / (sph_dot(dim, s.gradient, s.gradient) + i.m * s.square);
}

/* -------- divergence-free SPH: sweep */

SPH_FN sph_index sphi_dfsph_range(int walls, sph_kernel k, int dim, sph_cloud cloud, const sph_fluid *f,
                                  sph_scalars moves, sph_scalar_out out)
{
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real gx = SPH_R(0), gy = SPH_R(0), gz = SPH_R(0), square = SPH_R(0);
        sph_dfsph_sums sums;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], gx, gy, gz, square) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_dfsph_sums c = sph_pressure_factor_pair_dfsph(
                dim, sphi_at(f->m, j), walls ? sphi_at(moves, j) : SPH_R(1), x_ij,
                sph_kernel_f(k, dim, sph_length(dim, x_ij), sphi_mean_h(0, cloud.h, h_i, j)));
            gx += c.gradient.x;
            if (dim > 1) gy += c.gradient.y;
            if (dim > 2) gz += c.gradient.z;
            square += c.square;
        }
        sums.gradient.x = gx;
        sums.gradient.y = gy;
        sums.gradient.z = gz;
        sums.square = square;
        failed += square == SPH_R(0) && gx == SPH_R(0) && gy == SPH_R(0) && gz == SPH_R(0)
                      ? sphi_answer(out, i, SPH_R(0), SPH_TOO_FEW)
                      : sphi_store(out, i,
                                   sph_pressure_factor_value_dfsph(
                                       dim, sphi_fluid_side(SPHI_READ_M + SPHI_READ_RHO, f, f->m, i), sums));
    }
    return failed;
}
/* The factor alpha of DFSPH, see above. Of fluid, m is read, and rho of the targets. moves: 1 for
   particles that pressure moves, 0 for walls; null: all move. The targets are particles that move. A pair
   uses (h_i + h_j) / 2 (lists by SPH_MEAN). A target that no neighbour can push has the factor 0 and
   SPH_TOO_FEW. Returns the number of targets that are not SPH_OK, or a negative sph_error. */
SPH_FN sph_index sph_pressure_factor_dfsph(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                           sph_scalars moves, sph_scalar_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "m", fluid.m);
    if (!error) error = sphi_check_positive("m", fluid.m, cloud.points.n);
    if (!error) error = sphi_check_positive("rho", fluid.rho, cloud.last);
    if (!error && moves.p) error = sphi_check_field("moves", moves, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    return moves.p ? sphi_dfsph_range(1, k, dim, cloud, &fluid, moves, out)
                   : sphi_dfsph_range(0, k, dim, cloud, &fluid, moves, out);
}

/* ================================================================ Riemann solver for fluids
 *
 * Two neighbours i and j are the left and the right state of a Riemann problem along the line from i to j,
 * whose direction is e = -x_ij / r. With U = v . e and the impedance Z = rho c on each side, linear acoustics
 * gives pressure and velocity at the contact:
 *     P* = (Z_R P_L + Z_L P_R + beta Z_L Z_R (U_L - U_R)) / (Z_L + Z_R),
 *     U* = (Z_L U_L + Z_R U_R + P_L - P_R) / (Z_L + Z_R).
 * beta = 1 is the whole solver. With beta = 0 the velocities do not act on the pressure. The limiter between
 * them leaves shear and slow motion alone, and still catches shocks:
 *     beta = min(limiter max(U_L - U_R, 0) / c, 1),   limiter = 3.
 * What the pair does, in place of pressure, artificial viscosity and density diffusion:
 *     m_i a_i     = -2 sum_j V_i V_j P* grad_i W_ij,
 *     drho_i/dt   = 2 rho_i sum_j V_j (v_i - v*) . grad_i W_ij,   v* = (v_i + v_j) / 2 + (U* - mean of U) e.
 * Both terms that are new only take energy away: with D = 2 Z_L Z_R / (Z_L + Z_R), kinetic and elastic energy
 * together change at the rate
 *     sum over pairs of V_i V_j F_ij r (beta D (U_L - U_R)^2 + 2 (P_L - P_R)^2 / (Z_L + Z_R)) <= 0.
 * The first term becomes heat. The second is a diffusion of density, of delta-SPH's kind: with the constant
 * delta = r / (2 h), three to ten times the 0.1 that is usual there. It also diffuses a hydrostatic pressure:
 * the water of a tank at rest then moves, by 0.7 % of its depth in ten times sqrt(depth / g). With gravity
 * given (see sph_riemann_options), the difference that gravity makes, rho g . x_ij, is taken out of the jump
 * P_L - P_R in U*, and the water stays where it is, within 0.1 % (tests/test_riemann.c).
 *
 * Sources: Zhang, Hu & Adams 2017, JCP 335, 605 (the limiter, and the rates). Impedances on both sides: Toro
 * 2009, Riemann Solvers and Numerical Methods for Fluid Dynamics, 9.3 (acoustics with the states' own Z).
 * The heating is the part of the work of P* that beta adds.
 */

/* -------- Riemann solver: types */

/* One side: pressure, impedance Z = rho c > 0, and velocity along the line from left to right. */
typedef struct sph_riemann_side {
    sph_real p, z, u;
    SPHI_TCC_PAD
} sph_riemann_side;
/* The contact between the two: its pressure P* and velocity U*, and the part of P* that beta adds. */
typedef struct sph_riemann_star {
    sph_real p, u, viscous;
    SPHI_TCC_PAD
} sph_riemann_star;

/* -------- Riemann solver: pair functions */

/* A side of a pair. side is -1/2 for the particle i, the left one, and 1/2 for j. u is relative to the mean
   velocity of the two: side v_ij . x_ij / r, so that U_L - U_R = -v_ij . x_ij / r. Of the pair vx and r are
   read. Needs rho > 0 and c > 0. */
SPH_FN sph_riemann_side sph_riemann_side_of(sph_fluid_side a, sph_real c, sph_encounter e, sph_real side)
{
    sph_riemann_side s;
    SPH_ASSERT(a.rho > SPH_R(0) && c > SPH_R(0) && e.r >= SPH_R(0));
    s.p = a.p;
    s.z = a.rho * c + SPHI_TINY; /* the product may underflow */
    s.u = side * e.vx / (e.r + SPHI_TINY);
    return s;
}
/* beta = min(limiter max(U_L - U_R, 0) / c, 1), with c = (Z_L + Z_R) / (rho_L + rho_R). rho is the mean of
   the densities. limiter = 3 is usual; 0 gives beta = 0. Zhang, Hu & Adams 2017. Needs rho > 0, limiter >= 0
   and Z > 0 on both sides. */
SPH_FN sph_real sph_riemann_beta(sph_riemann_side left, sph_riemann_side right, sph_real rho,
                                 sph_real limiter)
{
    const sph_real inverse = SPH_R(1) / (left.z + right.z);
    SPH_ASSERT(left.z > SPH_R(0) && right.z > SPH_R(0) && rho > SPH_R(0) && limiter >= SPH_R(0));
    return SPH_R(1) - sphi_pos(SPH_R(1) - limiter * sphi_pos(left.u - right.u) * (SPH_R(2) * rho * inverse));
}
/* The part of P_i - P_j that a fluid at rest has: rho gravity . x_ij, with the mean of the densities. */
SPH_FN sph_real sph_riemann_rest(int dim, sph_real rho, sph_vec gravity, sph_vec x_ij)
{
    return rho * sph_dot(dim, gravity, x_ij);
}
/* The contact, as above. rest is the part of P_L - P_R that does not move it: 0, or sph_riemann_rest. Equal
   sides give P* = P and U* = U. A sound wave that meets a jump of Z goes on with the pressure
   2 Z_R / (Z_L + Z_R) of its own (beta = 1). Needs Z > 0 on both sides. */
SPH_FN sph_riemann_star sph_riemann_acoustic(sph_riemann_side left, sph_riemann_side right, sph_real beta,
                                             sph_real rest)
{
    const sph_real inverse = SPH_R(1) / (left.z + right.z), a = left.z * inverse, b = right.z * inverse;
    sph_riemann_star s;
    SPH_ASSERT(left.z > SPH_R(0) && right.z > SPH_R(0));
    s.viscous = beta * (a * right.z) * (left.u - right.u);
    s.p = b * left.p + a * right.p + s.viscous;
    s.u = a * left.u + b * right.u + (left.p - right.p - rest) * inverse;
    return s;
}
/* A whole interaction: what j adds to i. star is that of sides by sph_riemann_side_of. The acceleration is
   -2 m_j P* / (rho_i rho_j) F x_ij, the rate rho_i m_j / rho_j F (vx + 2 r U*), and the heating the half of
   the work of the viscous part. f_ij comes from sph_kernel_f_apart; of the pair vx and r are read. Needs
   rho > 0 on both sides. */
SPH_FN sph_fluid_change sph_fluid_pair_riemann(sph_fluid_side i, sph_fluid_side j, sph_riemann_star star,
                                               sph_vec x_ij, sph_encounter e, sph_real f_ij)
{
    const sph_real per = SPH_R(2) / (i.rho * j.rho);
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0));
    return sphi_fluid_change(j.m, per * star.p, per * star.viscous, x_ij, e.vx, f_ij,
                             sph_density_rate_pair_volume(i, j, e.vx + SPH_R(2) * e.r * star.u, f_ij));
}

/* -------- Riemann solver: sweep */

/* limiter: 0 means the usual 3; a negative number means beta = 1, the whole acoustic solver. gravity: the
   acceleration g, less that of the frame; 0 leaves the hydrostatic part in the jump. */
typedef struct sph_riemann_options {
    sph_real limiter;
    sph_vec gravity;
} sph_riemann_options;

SPH_FN sph_index sphi_riemann_range(int uniform, sph_kernel k, int dim, sph_cloud cloud, const sph_fluid *f,
                                    sph_riemann_options options, sph_fluid_out out)
{
    const size_t stride = sphi_stride(out.stride);
    const int reads = SPHI_READ_M + SPHI_READ_RHO + SPHI_READ_P;
    const int whole = options.limiter < SPH_R(0);
    const sph_real limiter = whole || options.limiter == SPH_R(0) ? SPH_R(3) : options.limiter;
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, f->v, i);
        const sph_real h_i = sphi_at(cloud.h, i), c_i = sphi_at(f->c, i);
        const sph_fluid_side own = sphi_fluid_side(reads, f, f->m, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0), rate = SPH_R(0), heating = SPH_R(0);
        sph_vec sum;
        int lost;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az, rate, heating) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_fluid_side other = sphi_fluid_side(reads, f, f->m, j);
            sph_riemann_side left, right;
            sph_riemann_star star;
            sph_fluid_change c;
            sph_encounter e;
            sph_real beta;
            e.vx = sph_dot(dim, sph_subtract(dim, v_i, sphi_vector_at(dim, f->v, j)), x_ij);
            e.r = sph_length(dim, x_ij);
            e.h = sphi_mean_h(uniform, cloud.h, h_i, j);
            e.rho = SPH_R(0.5) * (own.rho + other.rho);
            e.c = SPH_R(0); /* not read */
            left = sph_riemann_side_of(own, c_i, e, SPH_R(-0.5));
            right = sph_riemann_side_of(other, sphi_at(f->c, j), e, SPH_R(0.5));
            beta = whole ? SPH_R(1) : sph_riemann_beta(left, right, e.rho, limiter);
            star =
                sph_riemann_acoustic(left, right, beta, sph_riemann_rest(dim, e.rho, options.gravity, x_ij));
            c = sph_fluid_pair_riemann(own, other, star, x_ij, e, sph_kernel_f_apart(k, dim, e.r, e.h));
            ax += c.acceleration.x;
            if (dim > 1) ay += c.acceleration.y;
            if (dim > 2) az += c.acceleration.z;
            rate += c.rate;
            heating += c.heating;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        lost = sphi_store_vector(dim, out.acceleration, i, sum);
        lost |= sphi_put(out.rate, stride, i, rate);
        lost |= sphi_put(out.heating, stride, i, heating);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}
/* Acceleration, density rate and viscous heating of the targets by the Riemann solver, in one pass: the sums
   of sph_fluid_pair_riemann. Zhang, Hu & Adams 2017, JCP 335, 605. Of fluid, the members m, rho, p, c and v
   are read; c is positive. Neither viscosity nor alpha, beta and eta are read: the solver has a dissipation
   of its own. Physical viscosity is added by sph_viscosity_mu_morris. A pair uses (h_i + h_j) / 2 (lists by
   SPH_MEAN). It conserves momentum to round-off, also where the density jumps. Without gravity in options,
   energy never grows; give gravity where a fluid stands or pours under it. Gravity itself is not contained in
   the acceleration. Wall particles are sources like all others, with pressure and velocity from
   sph_wall_adami. out.rate, out.heating and out.status may be null. out.rate is that of the velocities given:
   for the order of a step that the chapter above tells, call it again with the new velocities. Returns the
   number of targets of which a result overflowed (it is 0 then), or a negative sph_error: SPH_ERROR_VALUE
   also for masses, densities and sound speeds that are not positive.
   Atlas: gradient exact for nothing, inside lattices for constants; order 0 inside lattices, -1 in
   disorder, -1 at boundaries.
   Atlas: keeps momentum and angular momentum; energy never grows. */
SPH_FN sph_index sph_fluid_rates_riemann(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                         sph_riemann_options options, sph_fluid_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "m", fluid.m);
    if (!error && !sphi_finite(options.limiter)) error = sphi_refuse("options.limiter", -1, SPH_ERROR_VALUE);
    if (!error && !sphi_finite(sph_dot(dim, options.gravity, options.gravity)))
        error = sphi_refuse("options.gravity", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_positive("m", fluid.m, cloud.points.n);
    if (!error) error = sphi_check_positive("rho", fluid.rho, cloud.points.n);
    if (!error) error = sphi_check_field("p", fluid.p, cloud.points.n);
    if (!error) error = sphi_check_positive("c", fluid.c, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, fluid.v, cloud.points.n);
    if (!error) error = sphi_check_out("out.acceleration", dim, out.acceleration);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_riemann_range(0, k, dim, cloud, &fluid, options, out)
                          : sphi_riemann_range(1, k, dim, cloud, &fluid, options, out);
}

/* ================================================================ surface tension
 *
 * A colour field c is 1 in one fluid and 0 in the other, and its gradient n is the normal, which points into
 * the first fluid: sph_gradient_difference gives it, for each particle. |n| is a delta function of the
 * width of the kernel: its integral across the interface is 1. With the tension sigma there are two ways to
 * a force by volume, which are the same in the continuum:
 *     CSS   div T with the stress T = sigma (|n| 1 - n n / |n|),
 *     CSF   sigma kappa n with the curvature kappa = -div(n / |n|), positive in a drop (c = 1 inside).
 * CSS is a force between pairs and keeps momentum to round-off; angular momentum only to the order of the
 * method. It takes the sharp c. CSF needs a c that has been smoothed once (sph_interpolate_shepard), because
 * |n| of a sharp one is ragged.
 *
 * What they are worth, for a drop of radius R in 2D on a square lattice (Wendland C2, h = 2 dx;
 * tests/test_tension.c). With R / dx of
 *                                                            8      16     32
 *     CSS: the jump of the pressure, over sigma / R          .98    .99    .99
 *     CSF: the same                                         1.03   1.02   1.02
 *     CSF: the error of kappa at a particle (rms), times R   .27    .45   1.16
 * The jump converges; the curvature at single particles does not: its error stays near 0.06 / h, because in
 * the fringe n is short and its direction uncertain. The force of CSF on all particles together is not 0: in
 * a cloud that is disturbed by 0.2 dx it is 1 % of the sum of its magnitudes at R = 8 dx. With CSS it is 0;
 * but on the same cloud these magnitudes sum to 1.1 (8 dx) and 1.5 times (16 dx) what they should, and drive
 * currents beside the interface that do not cease. CSS where momentum matters; CSF where a curvature is
 * wanted, or finer particles are to make the currents smaller (examples/fluids/README.md). Where the density
 * jumps, both give the lighter fluid the larger acceleration.
 *
 * Computer graphics has a third way, a cohesion between neighbours and a term that makes the surface small:
 * sph_tension_pair_akinci. It holds drops together, in fluids that have no second fluid around them. But its
 * coefficient is found by trial, and is no surface tension: nothing in it converges to sigma.
 *
 * Sources: Brackbill, Kothe & Zemach 1992, JCP 100, 335 (CSF); Morris 2000, IJNMF 33, 333 (CSF in SPH, and
 * which normals count); Lafaurie et al. 1994, JCP 113, 134 (CSS); Hu & Adams 2006, JCP 213, 844 (CSS in SPH);
 * Adami, Hu & Adams 2010, JCP 229, 5011 (the curvature's divisor); Akinci, Akinci & Teschner 2013, ACM Trans.
 * Graph. 32(6), 182.
 */

/* -------- surface tension: types */

/* A normal: unit = n / |n| and good = 1, or 0 and 0 where n is too short to have a direction. */
typedef struct sph_unit_normal {
    sph_vec unit;
    sph_real good;
} sph_unit_normal;
/* The sums of the curvature: flux = sum V_j (u_j - u_i) . grad_i W_ij and weight = sum V_j (-F_ij) r^2 over
   the neighbours whose normals are good; u = unit. */
typedef struct sph_curvature_sums {
    sph_real flux, weight;
} sph_curvature_sums;

/* -------- surface tension: pair functions */

/* n / |n|, or 0 if |n| <= least. Needs least >= 0. */
SPH_FN sph_unit_normal sph_unit_normal_of(int dim, sph_vec n, sph_real least)
{
    const sph_real size = sph_length(dim, n);
    sph_unit_normal u;
    SPH_ASSERT(least >= SPH_R(0));
    u.good = SPH_R(0.5) - SPHI_COPYSIGN(SPH_R(0.5), least - size); /* a comparison keeps loops scalar */
    u.unit = sph_scale(u.good / (size + SPHI_TINY), n);
    return u;
}
/* What j, of the volume V_j, adds to the sums of the curvature. Morris 2000. */
SPH_FN sph_curvature_sums sph_curvature_pair(int dim, sph_unit_normal i, sph_unit_normal j, sph_real V_j,
                                             sph_vec x_ij, sph_real f_ij)
{
    const sph_real v = j.good * V_j * f_ij;
    sph_curvature_sums c;
    c.flux = v * sph_dot(dim, sph_subtract(dim, j.unit, i.unit), x_ij);
    c.weight = -v * sph_dot(dim, x_ij, x_ij);
    return c;
}
/* kappa = -dim flux / weight, in 1 / length. The divisor makes it exact for unit normals that are linear in x
   alike in all directions, also where half of the neighbours do not count. Adami, Hu & Adams 2010. Needs
   weight > 0. */
SPH_FN sph_real sph_curvature_value(int dim, sph_curvature_sums s)
{
    SPH_ASSERT(SPHI_IS_DIM(dim) && s.weight > SPH_R(0));
    return SPH_R(-dim) * s.flux / s.weight;
}
/* CSF: the acceleration sigma curvature n / rho. Needs rho > 0. */
SPH_FN sph_vec sph_tension_csf_value(sph_real sigma, sph_real curvature, sph_vec n, sph_real rho)
{
    SPH_ASSERT(rho > SPH_R(0));
    return sph_scale(sigma * curvature / rho, n);
}
/* CSS: T x / sigma = |n| x - n (n . x) / |n|. It is 0 for n = 0, and for every n in 1D. */
SPH_FN sph_vec sph_tension_stress_times(int dim, sph_vec n, sph_vec x)
{
    const sph_real size = sph_length(dim, n);
    return sph_subtract(dim, sph_scale(size, x), sph_scale(sph_dot(dim, n, x) / (size + SPHI_TINY), n));
}
/* CSS: what j adds to the force by volume on i, V_j (T_i + T_j) grad_i W_ij, T in proportion to
   sigma; the acceleration is this sum by rho_i. Times V_i it is equal and opposite for j. */
SPH_FN sph_vec sph_tension_pair_css(int dim, sph_real sigma, sph_vec n_i, sph_vec n_j, sph_real V_j,
                                    sph_vec x_ij, sph_real f_ij)
{
    const sph_vec a = sph_tension_stress_times(dim, n_i, x_ij), b = sph_tension_stress_times(dim, n_j, x_ij);
    const sph_real v = sigma * V_j * f_ij;
    return sph_scale(v, sphi_plus(dim, a, b));
}
/* Akinci's cohesion and curvature, for computer graphics: what j adds to the acceleration of i,
       -2 gamma_rho0 / (rho_i + rho_j) (m_j C(r) x_ij / r + n_ij),   n_ij = n_i - n_j,
   with n_i = support sum_j V_j grad_i W_ij and gamma_rho0 = gamma rho0. C is sph_cohesion_kernel_akinci,
   which is normalised in 3D. gamma is found by trial. Equal and opposite for equal masses. Akinci, Akinci &
   Teschner 2013, (1), (4), (5). Of the sides m and rho are read, and m of j only. Needs rho > 0 on both
   sides. */
SPH_FN sph_vec sph_tension_pair_akinci(sph_fluid_side i, sph_fluid_side j, sph_vec x_ij, sph_vec n_ij,
                                       sph_real r, sph_real support, sph_real gamma_rho0)
{
    const sph_real factor = SPH_R(-2) * gamma_rho0 / (i.rho + j.rho);
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0));
    return sph_scale(
        factor,
        sphi_plus(3, n_ij, sph_scale(j.m * sph_cohesion_kernel_akinci(r, support) / (r + SPHI_TINY), x_ij)));
}

/* -------- surface tension: sweeps */

/* Density of the targets, and normal of all sources. */
typedef struct sph_tension {
    sph_scalars rho;
    sph_vectors normal; /* grad c, in 1 / length, and not of unit length */
    sph_real sigma;     /* tension, force / length */
    /* CSF: normals shorter than least / h do not count. 0 means the usual 0.01, a negative number 0. */
    sph_real least;
} sph_tension;
/* Where CSF's results go. curvature and status may be null; the stride is that of curvature. */
typedef struct sph_tension_out {
    sph_vector_out acceleration;
    SPH_GLOBAL sph_real *curvature;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_tension_out;

SPH_FN int sphi_check_tension(sph_kernel k, int dim, sph_cloud cloud, sph_tension tension)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_positive("rho", tension.rho, cloud.last);
    if (!error) error = sphi_check_vectors("normal", dim, tension.normal, cloud.points.n);
    if (!error && (!sphi_finite(tension.sigma) || !sphi_finite(tension.least)))
        error = sphi_refuse("tension.sigma, least", -1, SPH_ERROR_VALUE);
    return error;
}
/* a_i = (1 / rho_i) sum_j V_j (T_i + T_j) grad_i W_ij, surface tension by the stress (CSS; see above). A pair
   uses (h_i + h_j) / 2 (lists by SPH_MEAN). sum rho V a is 0 to round-off. Hu & Adams 2006. Of tension, least
   is not read. Returns the number of targets whose result overflowed (it is 0 then), or a negative
   sph_error. */
SPH_FN sph_index sph_tension_css(sph_kernel k, int dim, sph_cloud cloud, sph_tension tension,
                                 sph_vector_out acceleration)
{
    int error = sphi_check_tension(k, dim, cloud, tension);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_out("acceleration", dim, acceleration);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), n_i = sphi_vector_at(dim, tension.normal, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_real f_ij =
                sph_kernel_f_apart(k, dim, sph_length(dim, x_ij), sphi_mean_h(0, cloud.h, h_i, j));
            const sph_vec a =
                sph_tension_pair_css(dim, tension.sigma, n_i, sphi_vector_at(dim, tension.normal, j),
                                     sphi_at(cloud.volume, j), x_ij, f_ij);
            ax += a.x;
            if (dim > 1) ay += a.y;
            if (dim > 2) az += a.z;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        failed += sphi_store_vector(dim, acceleration, i, sph_scale(SPH_R(1) / sphi_at(tension.rho, i), sum));
    }
    return failed;
}
/* a_i = sigma kappa_i n_i / rho_i, surface tension by the curvature (CSF; see above), and kappa. W has the h
   of the target. Where n is shorter than least / h, both are 0. Where it is not, but no neighbour has a
   normal that counts, both are 0 with SPH_TOO_FEW; where one overflows, it is 0 with SPH_NOT_FINITE.
   Brackbill et al. 1992; Morris 2000. The direction of each neighbour's normal takes a root and a division:
   the time is 1.3 to 1.7 times that of sph_divergence_difference, and 2.1 times where the compiler does not
   vectorise. Returns the number of targets that are not SPH_OK, or a negative sph_error. */
SPH_FN sph_index sph_tension_csf(sph_kernel k, int dim, sph_cloud cloud, sph_tension tension,
                                 sph_tension_out out)
{
    const sph_real share = tension.least == SPH_R(0) ? SPH_R(0.01) : sphi_pos(tension.least);
    int error = sphi_check_tension(k, dim, cloud, tension);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_out("out.acceleration", dim, out.acceleration);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), n_i = sphi_vector_at(dim, tension.normal, i);
        const sph_real h_i = sphi_at(cloud.h, i), least = share / h_i;
        const sph_unit_normal own = sph_unit_normal_of(dim, n_i, least);
        sph_real flux = SPH_R(0), weight = SPH_R(0), curvature = SPH_R(0);
        sph_curvature_sums sums;
        int state = SPH_OK;
        if (own.good > SPH_R(0)) {
            SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], flux, weight) {
                const sph_index j = cloud.list.index[p];
                const sph_vec x_ij =
                    sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
                const sph_curvature_sums c = sph_curvature_pair(
                    dim, own, sph_unit_normal_of(dim, sphi_vector_at(dim, tension.normal, j), least),
                    sphi_at(cloud.volume, j), x_ij, sph_kernel_f_apart(k, dim, sph_length(dim, x_ij), h_i));
                flux += c.flux;
                weight += c.weight;
            }
            sums.flux = flux;
            sums.weight = weight;
            if (weight > SPH_R(0)) curvature = sph_curvature_value(dim, sums);
            else state = SPH_TOO_FEW;
        }
        if (sphi_put(out.curvature, sphi_stride(out.stride), i, curvature) |
            sphi_store_vector(dim, out.acceleration, i,
                              sph_tension_csf_value(tension.sigma, curvature, n_i, sphi_at(tension.rho, i))))
            state = SPH_NOT_FINITE;
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* ================================================================ walls by boundary integrals
 *
 * Near a wall the support is cut, and the share of the kernel that lies in the fluid is
 *     gamma(x) = integral over the fluid of W(|y - x|) dy.
 * For walls of flat elements (points in 1D, segments in 2D, triangles in 3D) gamma and its gradient are
 * integrals over the elements that have closed forms. With T = r^-dim integral_r^inf W s^(dim-1) ds, which
 * obeys div((y - x) T) = delta - W, and the normal n that points out of the fluid,
 *     gamma      = 1 - sum over elements of the integral of T (y - x) . n dS,
 *     grad gamma = -sum over elements of n times the integral of W dS.
 * T and W are piecewise polynomials of r, but for one power r^-dim. With the distance e to the line of a
 * segment or edge, the height d above the plane of a triangle, r^2 = s^2 + e^2 + d^2, and the angle phi in
 * that plane, all that is needed is, between the places where r passes a knot of the kernel,
 *     J_k = integral of r^k ds:     J_-1 = asinh(s / D),  J_0 = s,  J_k = (s r^k + k D^2 J_k-2) / (k + 1),
 *     I_k = integral of r^k dphi:   I_-1 = atan(d s / (e r)) / d,  I_0 = atan(s / e),
 *                                   I_k = e J_k-2 + d^2 I_k-2,      D^2 = e^2 + d^2.
 * There is no quadrature: gamma is exact to rounding, and does not change when elements are divided.
 *
 * Operators in sum form, with no particles in the wall:
 *     grad f   = (sum_j V_j f_j grad_i W_ij - f_w grad gamma) / gamma,
 *     lap f    = (sum_j 2 V_j (f_i - f_j) F_ij - 2 g_w . grad gamma) / gamma,
 * where f_w and g_w are f and its gradient at the wall. The second is the boundary integral method (BIM) in
 * more than one dimension: in 1D, with g_w = (f_b - f_i) / (x_b - x_i) for an end b, it is
 * sph_second_derivative_bim. The pressure force acts on a wall through grad gamma alone, so that momentum is
 * kept. As all sums without correction, these are as good as the sums: the error of the first is f times the
 * one of sum V grad W. Where that matters, it is taken for f - f_i (exact for constants, not conservative):
 * sph_wall_gradient_value with the result of sph_gradient_difference and f_w - f_i. For wendland-c2 on a
 * lattice that begins at dx / 2 from the wall (tests/test_walls.c),
 *     h / dx                                             1.3      1.65     2.0
 *     sum V W - gamma, at most                          .031     .015     .009
 *     gradient of f = x at the wall x = 0               .065     .027     .013
 *     the same without the wall's term                  .51      .50      .50
 * CSPM (sph_gradient_cspm) is exact for linear f there.
 *
 * Sources: Kulasegaram et al. 2004, Comput. Mech. 33, 316; Feldman & Bonet 2007, IJNME 72, 295; Macia et al.
 * 2012, Prog. Theor. Phys. 128, 439; Ferrand et al. 2013, IJNMF 71, 446 (the operators); Leroy et al. 2014,
 * JCP 261, 106 (closed forms in 2D for wendland-c2); Mayrhofer et al. 2015, Comput. Phys. Commun. 197, 192
 * (3D). The recursions above are for all kernels here that are piecewise polynomials: not the Gaussians, and
 * not schuessler-schmitt.
 */

/* -------- walls by boundary integrals: types */

/* A kernel as the polynomials that the elements integrate, in units of h: piece m reaches from knot[m] to
   knot[m + 1], and has the coefficients of q^-1, q^0, ..., q^14. `pieces` is 0 for a kernel that is none.
   Make it once for a kernel and dimension, by sph_wall_kernel_of. */
enum { SPH_WALL_PIECES = 4, SPH_WALL_POWERS = 16 };
typedef struct sph_wall_kernel {
    int dim, pieces;
    sph_real knot[SPH_WALL_PIECES + 1];
    sph_real volume[SPH_WALL_PIECES][SPH_WALL_POWERS];
    sph_real surface[SPH_WALL_PIECES][SPH_WALL_POWERS];
} sph_wall_kernel;
/* What an element adds: gamma = 1 + sum of gamma, grad gamma = sum of gradient. */
typedef struct sph_wall_part {
    sph_real gamma;
    sph_vec gradient;
} sph_wall_part;

/* -------- walls by boundary integrals: pair functions */

/* w(q) = sum over t of factor[t] (knot[t] - q)_+^power, of which the first term has the factor
   1 + p[0] q + p[1] q^2 + p[2] q^3. Knots descend. These are the formulas of sph_kernel_shape once more, as
   coefficients: there they are code that neither branches nor cancels, and a sum over such terms would be
   slower. Coefficients that are fitted to values of sph_kernel_shape have lost three digits (6e-5 for
   wendland-c6 in float). tests/test_walls.c holds each kernel's gamma beside a quadrature of its
   sph_kernel_w. */
typedef struct sphi_truncated {
    int terms, power;
    sph_real knot[SPH_WALL_PIECES], factor[SPH_WALL_PIECES], p[3];
} sphi_truncated;
SPH_FN sphi_truncated sphi_truncated_of(int power, sph_real factor, sph_real p1, sph_real p2, sph_real p3)
{
    sphi_truncated t;
    t.terms = 1;
    t.power = power;
    t.knot[0] = SPH_R(2);
    t.factor[0] = factor;
    t.p[0] = p1;
    t.p[1] = p2;
    t.p[2] = p3;
    return t;
}
SPH_FN void sphi_truncated_add(sphi_truncated *t, sph_real knot, sph_real factor)
{
    t->knot[t->terms] = knot;
    t->factor[t->terms++] = factor;
}
SPHI_LARGE sphi_truncated sphi_truncated_shape(sph_kernel k)
{
    sphi_truncated t = sphi_truncated_of(0, SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0));
    t.terms = 0;
    switch (k) {
    case SPH_CUBIC_SPLINE:
    case SPH_CORE_TRIANGLE:
        t = sphi_truncated_of(3, SPH_R(0.25), SPH_R(0), SPH_R(0), SPH_R(0));
        sphi_truncated_add(&t, SPH_R(1), SPH_R(-1));
        if (k == SPH_CORE_TRIANGLE) sphi_truncated_add(&t, SPH_R(0.666666666666666667), SPH_R(0.75));
        return t;
    case SPH_QUARTIC_SPLINE:
        t = sphi_truncated_of(4, SPH_R(1), SPH_R(0), SPH_R(0), SPH_R(0));
        t.knot[0] = SPH_R(2.5);
        sphi_truncated_add(&t, SPH_R(1.5), SPH_R(-5));
        sphi_truncated_add(&t, SPH_R(0.5), SPH_R(10));
        return t;
    case SPH_QUINTIC_SPLINE:
        t = sphi_truncated_of(5, SPH_R(1), SPH_R(0), SPH_R(0), SPH_R(0));
        t.knot[0] = SPH_R(3);
        sphi_truncated_add(&t, SPH_R(2), SPH_R(-6));
        sphi_truncated_add(&t, SPH_R(1), SPH_R(15));
        return t;
    case SPH_SEXTIC_SPLINE:
        t = sphi_truncated_of(6, SPH_R(1), SPH_R(0), SPH_R(0), SPH_R(0));
        t.knot[0] = SPH_R(3.5);
        sphi_truncated_add(&t, SPH_R(2.5), SPH_R(-7));
        sphi_truncated_add(&t, SPH_R(1.5), SPH_R(21));
        sphi_truncated_add(&t, SPH_R(0.5), SPH_R(-35));
        return t;
    case SPH_HEPTIC_SPLINE:
        t = sphi_truncated_of(7, SPH_R(1), SPH_R(0), SPH_R(0), SPH_R(0));
        t.knot[0] = SPH_R(4);
        sphi_truncated_add(&t, SPH_R(3), SPH_R(-8));
        sphi_truncated_add(&t, SPH_R(2), SPH_R(28));
        sphi_truncated_add(&t, SPH_R(1), SPH_R(-56));
        return t;
    case SPH_WENDLAND_C2:
        return sphi_truncated_of(4, SPH_R(0.0625), SPH_R(2), SPH_R(0), SPH_R(0));
    case SPH_WENDLAND_C4:
        return sphi_truncated_of(6, SPH_R(0.015625), SPH_R(3), SPH_R(2.91666666666666667), SPH_R(0));
    case SPH_WENDLAND_C6:
        return sphi_truncated_of(8, SPH_R(0.00390625), SPH_R(4), SPH_R(6.25), SPH_R(4));
    case SPH_WENDLAND_C2_1D:
        return sphi_truncated_of(3, SPH_R(0.125), SPH_R(1.5), SPH_R(0), SPH_R(0));
    case SPH_WENDLAND_C4_1D:
        return sphi_truncated_of(5, SPH_R(0.03125), SPH_R(2.5), SPH_R(2), SPH_R(0));
    case SPH_WENDLAND_C6_1D:
        return sphi_truncated_of(7, SPH_R(0.0078125), SPH_R(3.5), SPH_R(4.75), SPH_R(2.625));
    case SPH_LIU_QUARTIC:
        return sphi_truncated_of(2, SPH_R(0.166666666666666667), SPH_R(1), SPH_R(-0.9375), SPH_R(0));
    case SPH_HERMITE:
        return sphi_truncated_of(2, SPH_R(1), SPH_R(1), SPH_R(0), SPH_R(0));
    case SPH_JOHNSON_BEISSEL:
        return sphi_truncated_of(2, SPH_R(0.25), SPH_R(0), SPH_R(0), SPH_R(0));
    case SPH_CONVEX:
        return sphi_truncated_of(3, SPH_R(1), SPH_R(0.5), SPH_R(0), SPH_R(0));
    case SPH_CONVEX_CUBIC_SPLINE:
        t = sphi_truncated_of(4, SPH_R(0.0833333333333333333), SPH_R(0), SPH_R(0), SPH_R(0));
        sphi_truncated_add(&t, SPH_R(1), SPH_R(-0.333333333333333333));
        return t;
    case SPH_CONVEX_WENDLAND_C2:
        return sphi_truncated_of(5, SPH_R(0.03125), SPH_R(1), SPH_R(0), SPH_R(0));
    case SPH_CONVEX_WENDLAND_C4:
        return sphi_truncated_of(7, SPH_R(0.0078125), SPH_R(1.8125), SPH_R(1.09375), SPH_R(0));
    case SPH_POLY6:
        return sphi_truncated_of(3, SPH_R(0.125), SPH_R(1.5), SPH_R(0.75), SPH_R(0.125));
    case SPH_SPIKY:
        return sphi_truncated_of(3, SPH_R(0.125), SPH_R(0), SPH_R(0), SPH_R(0));
    case SPH_GAUSSIAN:
    case SPH_SUPER_GAUSSIAN:
    case SPH_SCHUESSLER_SCHMITT:
    case SPH_KERNEL_COUNT:
    default:
        return t;
    }
}
/* The value of a piece at q > 0, without its power -1. */
SPH_FN sph_real sphi_wall_polynomial(const sph_real *c, sph_real q)
{
    sph_real value = SPH_R(0);
    int p;
    for (p = SPH_WALL_POWERS - 1; p > 0; p--) value = value * q + c[p];
    return value;
}
/* into = the integral of from s^power from q to the end of the support, where power is 0, 1, 2 or -2. For -2,
   `from` has no term in q. */
SPH_FN void sphi_wall_integral(const sph_wall_kernel *t, int power, sph_real (*from)[SPH_WALL_POWERS],
                               sph_real (*into)[SPH_WALL_POWERS])
{
    sph_real outside = SPH_R(0); /* its value at the outer knot */
    int m, p;
    for (m = t->pieces - 1; m >= 0; m--) {
        const sph_real inner = t->knot[m], outer = t->knot[m + 1];
        sph_real c[SPH_WALL_POWERS];
        for (p = 0; p < SPH_WALL_POWERS; p++) c[p] = SPH_R(0);
        for (p = 1; p < SPH_WALL_POWERS; p++) { /* q^(p - 1) becomes q^(p + power), at p + power + 1 */
            const int to = p + power + 1;
            if (to >= 0 && to < SPH_WALL_POWERS && to != 1) c[to] -= from[m][p] / SPH_R(p + power);
        }
        c[1] = outside - sphi_wall_polynomial(c, outer) - c[0] / outer;
        for (p = 0; p < SPH_WALL_POWERS; p++) into[m][p] = c[p];
        if (m > 0) outside = sphi_wall_polynomial(c, inner) + c[0] / inner;
    }
}
SPHI_LARGE sph_wall_kernel sphi_wall_kernel_make(sph_kernel k, int dim)
{
    const sphi_truncated shape = sphi_truncated_shape(k);
    sph_real w[SPH_WALL_PIECES][SPH_WALL_POWERS], moment[SPH_WALL_PIECES][SPH_WALL_POWERS];
    sph_wall_kernel t;
    int m, p, i, l;
    t.dim = dim;
    t.pieces = shape.terms;
    for (m = 0; m < SPH_WALL_PIECES; m++)
        for (p = 0; p < SPH_WALL_POWERS; p++)
            w[m][p] = moment[m][p] = t.volume[m][p] = t.surface[m][p] = SPH_R(0);
    for (m = 0; m <= SPH_WALL_PIECES; m++)
        t.knot[m] = m > 0 && m <= shape.terms ? shape.knot[shape.terms - m] : SPH_R(0);
    for (i = 0; i < shape.terms; i++) {
        sph_real c[SPH_WALL_POWERS];
        for (p = 0; p < SPH_WALL_POWERS; p++) c[p] = SPH_R(0);
        c[1] = sph_kernel_sigma(k, dim) * shape.factor[i];
        for (p = 0; p < 3 && i == 0; p++) c[p + 2] = c[1] * shape.p[p];
        for (l = 0; l < shape.power; l++)
            for (p = SPH_WALL_POWERS - 1; p > 0; p--)
                c[p] = shape.knot[i] * c[p] - (p > 1 ? c[p - 1] : SPH_R(0));
        for (m = 0; m < shape.terms - i; m++)
            for (p = 0; p < SPH_WALL_POWERS; p++) w[m][p] += c[p];
    }
    if (dim == 1) sphi_wall_integral(&t, 0, w, t.volume);
    if (dim == 2) sphi_wall_integral(&t, 1, w, t.volume);
    if (dim == 3) {
        sphi_wall_integral(&t, 2, w, moment);
        sphi_wall_integral(&t, -2, moment, t.volume);
        sphi_wall_integral(&t, 1, w, t.surface);
    } else
        for (m = 0; m < SPH_WALL_PIECES; m++)
            for (p = 0; p < SPH_WALL_POWERS; p++) t.surface[m][p] = w[m][p];
    return t;
}
/* The polynomials of a kernel in dim dimensions. */
SPH_FN sph_wall_kernel sph_wall_kernel_of(sph_kernel k, int dim)
{
    SPH_ASSERT(SPHI_IS_KERNEL(k) && SPHI_IS_DIM(dim));
    return sphi_wall_kernel_make(k, dim);
}

/* Integrals along a line or an edge: of the volume polynomial by dphi (in 3D times d), and of the surface
   polynomial by ds (2D) or dphi (3D). */
typedef struct sphi_wall_sums {
    sph_real volume, surface;
} sphi_wall_sums;
/* Their antiderivatives in piece m at s >= 0. */
SPH_FN sphi_wall_sums sphi_wall_primitive(const sph_wall_kernel *t, int m, sph_real s, sph_real e, sph_real d)
{
    const sph_real scale = t->dim == 3 ? d : SPH_R(1), dd = d * d, whole2 = e * e + dd,
                   r = SPHI_SQRT(s * s + whole2), whole = SPHI_SQRT(whole2);
    /* of two powers in turn: J_k-2 and I_k-2, and r^k */
    sph_real j[2], i[2], power[2], odd_i;
    sphi_wall_sums sum;
    int k;
    j[1] = whole > SPHI_TINY ? SPHI_LOG((s + r) / whole)
                             : SPH_R(0); /* J_-1; it is multiplied by whole or e below */
    j[0] = s;
    odd_i = SPHI_ATAN2(d * s, e * r); /* d I_-1 */
    i[1] = SPH_R(0);
    i[0] = SPHI_ATAN2(s, e);
    power[0] = SPH_R(1);
    power[1] = r;
    sum.volume = t->volume[m][0] * odd_i;
    sum.surface = SPH_R(0);
    for (k = 0; k < SPH_WALL_POWERS - 1; k++) {
        const int o = k & 1;
        if (k > 0) {
            const sph_real before = j[o];
            if (k > 1) power[o] *= r * r;
            i[o] = e * before + (k == 1 ? d * odd_i : dd * i[o]);
            j[o] = (s * power[o] + SPH_R(k) * whole2 * before) / SPH_R(k + 1);
        }
        sum.volume += scale * t->volume[m][k + 1] * i[o];
        sum.surface += t->surface[m][k + 1] * (t->dim == 3 ? i[o] : j[o]);
    }
    return sum;
}
/* From s = low to high, 0 <= low <= high, cut at the knots. Needs e >= 0 and d >= 0. */
SPH_FN sphi_wall_sums sphi_wall_stretch(const sph_wall_kernel *t, sph_real low, sph_real high, sph_real e,
                                        sph_real d)
{
    const sph_real whole = SPHI_SQRT(e * e + d * d);
    sphi_wall_sums sum;
    int m;
    sum.volume = sum.surface = SPH_R(0);
    for (m = 0; m < t->pieces; m++) {
        const sph_real a = t->knot[m], b = t->knot[m + 1];
        sph_real from = a > whole ? SPHI_SQRT((a - whole) * (a + whole)) : SPH_R(0),
                 to = b > whole ? SPHI_SQRT((b - whole) * (b + whole)) : SPH_R(0);
        if (from < low) from = low;
        if (to > high) to = high;
        if (to > from) {
            const sphi_wall_sums end = sphi_wall_primitive(t, m, to, e, d),
                                 begin = sphi_wall_primitive(t, m, from, e, d);
            sum.volume += end.volume - begin.volume;
            sum.surface += end.surface - begin.surface;
        }
    }
    return sum;
}
/* From s0 to s1 of any sign; the integrands are even. */
SPHI_LARGE sphi_wall_sums sphi_wall_line(const sph_wall_kernel *t, sph_real s0, sph_real s1, sph_real e,
                                         sph_real d)
{
    const sph_real a = SPHI_ABS(s0), b = SPHI_ABS(s1);
    sphi_wall_sums sum, more;
    if ((s0 < SPH_R(0)) == (s1 < SPH_R(0))) return sphi_wall_stretch(t, a < b ? a : b, a < b ? b : a, e, d);
    sum = sphi_wall_stretch(t, SPH_R(0), a, e, d);
    more = sphi_wall_stretch(t, SPH_R(0), b, e, d);
    sum.volume += more.volume;
    sum.surface += more.surface;
    return sum;
}

/* The part of a wall at a point, in 1D: e = x_wall - x, and normal = 1 or -1 points out of the fluid. Needs a
   table with pieces, in this and the next two. */
SPH_FN sph_wall_part sph_wall_point(const sph_wall_kernel *t, sph_real e, sph_real normal, sph_real h)
{
    const sph_real q = SPHI_ABS(e) / h, side = e * normal < SPH_R(0) ? SPH_R(-1) : SPH_R(1);
    sph_wall_part part;
    int m = 0;
    SPH_ASSERT(t->dim == 1 && t->pieces > 0 && h > SPH_R(0));
    part.gamma = part.gradient.x = part.gradient.y = part.gradient.z = SPH_R(0);
    while (m < t->pieces && !(q < t->knot[m + 1])) m++;
    if (m == t->pieces) return part;
    part.gamma = -side * sphi_wall_polynomial(t->volume[m], q);
    part.gradient.x = -normal * sphi_wall_polynomial(t->surface[m], q) / h;
    return part;
}
/* The part of a segment, in 2D, from a to b, both relative to x. The fluid is on the left of it. On the
   segment itself the answer is the limit from inside. Leroy et al. 2014 give it for one kernel. */
SPH_FN sph_wall_part sph_wall_segment(const sph_wall_kernel *t, sph_vec a, sph_vec b, sph_real h)
{
    const sph_vec ab = sph_subtract(2, b, a);
    const sph_real size = sph_length(2, ab), inverse = SPH_R(1) / (size + SPHI_TINY);
    const sph_real tx = ab.x * inverse, ty = ab.y * inverse;
    const sph_real d = (a.x * ty - a.y * tx) / h; /* (y - x) . n with n = (ty, -tx) */
    const sph_real s0 = (a.x * tx + a.y * ty) / h, s1 = s0 + size / h;
    sph_wall_part part;
    sphi_wall_sums sum;
    SPH_ASSERT(t->dim == 2 && t->pieces > 0 && h > SPH_R(0));
    sum = sphi_wall_line(t, s0, s1, SPHI_ABS(d), SPH_R(0));
    part.gamma = d < SPH_R(0) ? sum.volume : -sum.volume;
    part.gradient.x = -ty * sum.surface / h;
    part.gradient.y = tx * sum.surface / h;
    part.gradient.z = SPH_R(0);
    return part;
}
/* The part of a triangle, in 3D, with the corners a, b, c relative to x. The normal (b - a) x (c - a) points
   out of the fluid. In its plane the integral by r dr is done first; the edges remain. */
SPH_FN sph_wall_part sph_wall_triangle(const sph_wall_kernel *t, sph_vec a, sph_vec b, sph_vec c, sph_real h)
{
    const sph_vec full = sphi_cross(sph_subtract(3, b, a), sph_subtract(3, c, a));
    const sph_vec n = sph_scale(SPH_R(1) / (sph_length(3, full) + SPHI_TINY), full);
    const sph_real signed_d = sph_dot(3, a, n) / h, d = SPHI_ABS(signed_d);
    sph_real angle = SPH_R(0), volume = SPH_R(0), surface = SPH_R(0);
    sph_wall_part part;
    int m = 0, edge;
    SPH_ASSERT(t->dim == 3 && t->pieces > 0 && h > SPH_R(0));
    part.gamma = part.gradient.x = part.gradient.y = part.gradient.z = SPH_R(0);
    while (m < t->pieces && !(d < t->knot[m + 1])) m++;
    if (m == t->pieces) return part;
    for (edge = 0; edge < 3; edge++) {
        const sph_vec from = edge == 0 ? a : edge == 1 ? b : c, to = edge == 0 ? b : edge == 1 ? c : a;
        const sph_vec along = sph_subtract(3, to, from);
        const sph_real size = sph_length(3, along);
        const sph_vec tangent = sph_scale(SPH_R(1) / (size + SPHI_TINY), along);
        const sph_real e = sph_dot(3, from, sphi_cross(tangent, n)) / h, s0 = sph_dot(3, from, tangent) / h,
                       s1 = s0 + size / h, apart = SPHI_ABS(e);
        const sph_real sign = e > SPH_R(0) ? SPH_R(1) : e < SPH_R(0) ? SPH_R(-1) : SPH_R(0);
        const sphi_wall_sums sum = sphi_wall_line(t, s0, s1, apart, d);
        angle += sign * (SPHI_ATAN2(s1, apart) - SPHI_ATAN2(s0, apart));
        volume -= sign * sum.volume;
        surface -= sign * sum.surface;
    }
    volume += angle * (t->volume[m][0] + d * sphi_wall_polynomial(t->volume[m], d));
    surface += angle * sphi_wall_polynomial(t->surface[m], d);
    part.gamma = signed_d < SPH_R(0) ? volume : -volume;
    part.gradient = sph_scale(-surface / h, n);
    return part;
}

/* The gradient from the sum of sph_gradient_pair_difference for f_j in the place of f_j - f_i, f_w at the
   wall, gamma and its gradient. Needs gamma > 0. */
SPH_FN sph_vec sph_wall_gradient_value(int dim, sph_vec sum, sph_real f_w, sph_real gamma, sph_vec gradient)
{
    SPH_ASSERT(gamma > SPH_R(0));
    return sph_scale(SPH_R(1) / gamma, sph_subtract(dim, sum, sph_scale(f_w, gradient)));
}
/* The Laplacian from Brookshaw's sum, the gradient g_w of f at the wall, gamma and its gradient. Needs
   gamma > 0. */
SPH_FN sph_real sph_wall_laplacian_value(int dim, sph_real sum, sph_vec g_w, sph_real gamma, sph_vec gradient)
{
    SPH_ASSERT(gamma > SPH_R(0));
    return (sum - SPH_R(2) * sph_dot(dim, g_w, gradient)) / gamma;
}

/* -------- walls by boundary integrals: sweeps */

/* Flat elements, in order: a point a with b anywhere behind it (1D), a segment from a to b with the fluid on
   its left (2D), a triangle a, b, c whose normal (b - a) x (c - a) points out of the fluid (3D). Together
   they close the fluid, at least where supports reach. */
typedef struct sph_wall_elements {
    sph_index n;
    sph_vectors a, b, c; /* one corner of each element; c is read in 3D only */
    sph_list list;       /* the elements near each target; null: all are looked at */
} sph_wall_elements;
/* Where gamma and its gradient go. The stride is that of gamma; status may be null. */
typedef struct sph_wall_gamma_out {
    SPH_GLOBAL sph_real *gamma;
    sph_vector_out gradient;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_wall_gamma_out;
/* What an operator reads of the wall, all of the targets: gamma and its gradient; f_w (`value`, for
   sph_wall_gradient) or g_w (`slope`, for sph_wall_laplacian). */
typedef struct sph_wall_terms {
    sph_scalars gamma;
    sph_vectors gradient;
    sph_scalars value;
    sph_vectors slope;
} sph_wall_terms;

/* An element relative to x, by the image of it that is the nearest. */
typedef struct sphi_wall_corners {
    sph_vec a, b, c;
} sphi_wall_corners;
SPH_FN sphi_wall_corners sphi_wall_element(int dim, sph_points points, const sph_wall_elements *elements,
                                           sph_index e, sph_vec x)
{
    sphi_wall_corners at;
    at.a = sphi_vector_at(dim, elements->a, e);
    at.b = sphi_vector_at(dim, elements->b, e);
    at.c = dim > 2 ? sphi_vector_at(dim, elements->c, e) : at.b;
    {
        const sph_vec middle = sph_scale(SPH_R(0.5), sphi_plus(dim, at.a, at.b));
        const sph_vec home = sph_subtract(dim, sphi_separation(dim, points, middle, x), middle);
        at.a = sphi_plus(dim, home, at.a);
        at.b = sphi_plus(dim, home, at.b);
        at.c = sphi_plus(dim, home, at.c);
    }
    return at;
}
/* The normal of an element that passes closer to x than `reach`, else 0. */
SPH_FN sph_vec sphi_wall_touched(int dim, sphi_wall_corners at, sph_real reach)
{
    const sph_vec none = {SPH_R(0), SPH_R(0), SPH_R(0)}, ab = sph_subtract(dim, at.b, at.a);
    sph_vec n = none;
    if (dim == 1) {
        n.x = ab.x < SPH_R(0) ? SPH_R(-1) : SPH_R(1);
        return SPHI_ABS(at.a.x) < reach ? n : none;
    }
    if (dim == 2) {
        const sph_vec t = sph_scale(SPH_R(1) / (sph_length(2, ab) + SPHI_TINY), ab);
        n.x = t.y;
        n.y = -t.x;
        return SPHI_ABS(sph_dot(2, at.a, n)) < reach && sph_dot(2, at.a, t) < reach &&
                       sph_dot(2, at.b, t) > -reach
                   ? n
                   : none;
    }
    n = sphi_cross(ab, sph_subtract(3, at.c, at.a));
    n = sph_scale(SPH_R(1) / (sph_length(3, n) + SPHI_TINY), n);
    {
        const sph_vec p = sphi_cross(ab, n), q = sphi_cross(sph_subtract(3, at.c, at.b), n),
                      r = sphi_cross(sph_subtract(3, at.a, at.c), n);
        return SPHI_ABS(sph_dot(3, at.a, n)) < reach &&
                       sph_dot(3, at.a, p) > -reach * (sph_length(3, p) + SPHI_TINY) &&
                       sph_dot(3, at.b, q) > -reach * (sph_length(3, q) + SPHI_TINY) &&
                       sph_dot(3, at.c, r) > -reach * (sph_length(3, r) + SPHI_TINY)
                   ? n
                   : none;
    }
}
SPH_FN sph_wall_part sphi_wall_part(int dim, const sph_wall_kernel *t, sphi_wall_corners at, sph_real h)
{
    if (dim == 1) return sph_wall_point(t, at.a.x, at.b.x < at.a.x ? SPH_R(-1) : SPH_R(1), h);
    return dim == 2 ? sph_wall_segment(t, at.a, at.b, h) : sph_wall_triangle(t, at.a, at.b, at.c, h);
}
/* gamma and grad gamma of the targets, from the elements of the walls. The targets are in the fluid or on its
   walls; for one outside, gamma is too large by 1. A target within sqrt(SPH_EPSILON) h of an element, an edge
   or a corner is taken as many lengths further inside, which gives the limit (1/2 on a plane, 1/4 in the
   corner of a square) with an error of this order. Of cloud, positions, h and the range are read, no list
   and no volumes. In a periodic box an element and a support together must be shorter than half of the box.
   The work is that of all elements for each target, unless elements.list says which are near. Returns the
   number of targets whose result overflowed (it is 0 then), or a negative sph_error: SPH_ERROR_KERNEL for the
   kernels that are not piecewise polynomials, SPH_ERROR_COUNT for a negative number of elements. */
SPH_FN sph_index sph_wall_gamma(sph_kernel k, int dim, sph_cloud cloud, sph_wall_elements elements,
                                sph_wall_gamma_out out)
{
    const int listed = elements.list.start != 0;
    int error = sphi_check_targets(dim, cloud);
    sph_real largest = SPH_R(0);
    sph_wall_kernel t;
    sph_index i, p, failed = 0;
    if (error >= 0 && sphi_check_kernel(k)) return SPH_ERROR_KERNEL;
    if (!error) error = sphi_check_arrays(dim, cloud.points);
    if (!error && !cloud.h.p) error = sphi_refuse("h", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_h("h", cloud.h, cloud.points.n, &largest);
    if (!error && cloud.checked != 1) error = sphi_check_positions(dim, cloud.points);
    if (!error)
        error = sphi_check_box(dim, cloud.points, sph_kernel_support_ratio(k) * largest, cloud.checked == 1);
    if (!error && elements.n < 0) error = sphi_refuse("elements.n", -1, SPH_ERROR_COUNT);
    if (!error && elements.n > 0) {
        error = sphi_check_vectors("elements.a", dim, elements.a, elements.n);
        if (!error) error = sphi_check_vectors("elements.b", dim, elements.b, elements.n);
        if (!error && dim > 2) error = sphi_check_vectors("elements.c", dim, elements.c, elements.n);
    }
    if (!error && listed) error = sphi_check_entries(cloud.first, cloud.last, elements.list, elements.n, 1);
    if (!error && !out.gamma) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_out("out.gradient", dim, out.gradient);
    if (error) return sphi_answer_of(error);
    t = sph_wall_kernel_of(k, dim);
    if (t.pieces == 0) return sphi_refuse("kernel", -1, SPH_ERROR_KERNEL);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_index from = listed ? elements.list.start[i] : 0,
                        to = listed ? elements.list.start[i + 1] : elements.n;
        const sph_real h_i = sphi_at(cloud.h, i), reach = SPHI_SQRT(SPH_EPSILON) * h_i;
        sph_vec x = sphi_point(dim, cloud.points, i), out_of = {SPH_R(0), SPH_R(0), SPH_R(0)},
                gradient = {SPH_R(0), SPH_R(0), SPH_R(0)};
        sph_real gamma = SPH_R(1);
        int lost;
        for (p = from; p < to; p++) {
            const sph_index e = listed ? elements.list.index[p] : p;
            out_of = sphi_plus(
                dim, out_of,
                sphi_wall_touched(dim, sphi_wall_element(dim, cloud.points, &elements, e, x), reach));
        }
        x = sph_subtract(dim, x, sph_scale(SPH_R(2) * reach / (sph_length(dim, out_of) + SPHI_TINY), out_of));
        for (p = from; p < to; p++) {
            const sph_index e = listed ? elements.list.index[p] : p;
            const sph_wall_part part =
                sphi_wall_part(dim, &t, sphi_wall_element(dim, cloud.points, &elements, e, x), h_i);
            gamma += part.gamma;
            gradient.x += part.gradient.x;
            if (dim > 1) gradient.y += part.gradient.y;
            if (dim > 2) gradient.z += part.gradient.z;
        }
        lost = sphi_put(out.gamma, sphi_stride(out.stride), i, gamma);
        lost |= sphi_store_vector(dim, out.gradient, i, gradient);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}

SPH_FN int sphi_check_wall(sph_kernel k, int dim, sph_cloud cloud, sph_wall_terms wall)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_positive("wall.gamma", wall.gamma, cloud.last);
    return error ? error : sphi_check_vectors("wall.gradient", dim, wall.gradient, cloud.last);
}
/* grad f_i = (sum_j V_j f_j grad_i W_ij - f_w grad gamma_i) / gamma_i, the particles of the fluid being all
   sources, with wall.value the f_w of each target. Ferrand et al. 2013. W has the h of the target. For its
   error see above. SPH_ERROR_VALUE for a gamma that is not positive. Returns the number of targets whose
   result overflowed (it is 0 then), or a negative sph_error.
   Atlas: gradient exact for nothing, inside lattices for constants; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_wall_gradient(sph_kernel k, int dim, sph_cloud cloud, sph_wall_terms wall, sph_scalars f,
                                   sph_vector_out out)
{
    int error = sphi_check_wall(k, dim, cloud, wall);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error) error = sphi_check_field("wall.value", wall.value, cloud.last);
    if (!error) error = sphi_check_out("out", dim, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sx, sy, sz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_vec g = sph_gradient_pair_difference(k, dim, sphi_at(cloud.volume, j), sphi_at(f, j),
                                                           x_ij, sph_length(dim, x_ij), h_i);
            sx += g.x;
            sy += g.y;
            sz += g.z;
        }
        sum.x = sx;
        sum.y = sy;
        sum.z = sz;
        failed += sphi_store_vector(dim, out, i,
                                    sph_wall_gradient_value(dim, sum, sphi_at(wall.value, i),
                                                            sphi_at(wall.gamma, i),
                                                            sphi_vector_at(dim, wall.gradient, i)));
    }
    return failed;
}
/* The same gradient as rows, for an f that is not known yet:
       grad f_i = sum_p (x[p], y[p], z[p]) f_j + source_i,
   with the weights V_j F_ij x_ij / gamma_i, and source_i = -f_w grad gamma_i / gamma_i. In contrast to
   sph_gradient_rows_cspm they multiply f_j, not f_j - f_i: this is the sum form. The conditioning of out is
   1. The weight of f_w itself is the source for wall.value = 1. Where a row or its source overflows, both are
   0, with SPH_NOT_FINITE. Returns the number of these targets, or a negative sph_error. */
SPH_FN sph_index sph_wall_gradient_rows(sph_kernel k, int dim, sph_cloud cloud, sph_wall_terms wall,
                                        sph_gradient_rows_out out, sph_vector_out source)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT wx = out.x, *const SPH_RESTRICT wy = out.y,
                                            *const SPH_RESTRICT wz = out.z;
    const sph_vec none = {SPH_R(0), SPH_R(0), SPH_R(0)};
    int error = sphi_check_wall(k, dim, cloud, wall);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("wall.value", wall.value, cloud.last);
    if (!error) error = sphi_check_out("out", dim, sph_vector_out_separate(wx, wy, wz));
    if (!error) error = sphi_check_out("source", dim, source);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), nabla = sphi_vector_at(dim, wall.gradient, i);
        const sph_real h_i = sphi_at(cloud.h, i), gamma = sphi_at(wall.gamma, i);
        int lost;
        SPH_EACH(p, cloud.list.start[i], cloud.list.start[i + 1]) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_vec pair = sph_gradient_pair_difference(k, dim, sphi_at(cloud.volume, j), SPH_R(1),
                                                              x_ij, sph_length(dim, x_ij), h_i);
            const sph_vec w = sph_wall_gradient_value(dim, pair, SPH_R(0), gamma, nabla);
            wx[p] = w.x;
            if (dim > 1) wy[p] = w.y;
            if (dim > 2) wz[p] = w.z;
        }
        lost = sphi_store_vector(dim, source, i,
                                 sph_wall_gradient_value(dim, none, sphi_at(wall.value, i), gamma, nabla));
        lost = sphi_gradient_row_finite(dim, out, cloud.list, i, lost);
        if (lost) sphi_store_vector(dim, source, i, none);
        sphi_put(out.conditioning, sphi_stride(out.stride), i, SPH_R(1));
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}
/* lap f_i = (sum_j 2 V_j (f_i - f_j) F_ij - 2 g_w . grad gamma_i) / gamma_i, with wall.slope the g_w of each
   target: the gradient of f at the wall, of which the part along the normal counts. Where f_w is given
   instead, at the distance d in front of one wall, g_w = (f_w - f_i) / d n. Macia et al. 2012; Ferrand et al.
   2013, who take the mean of the gradients on both sides. Errors and answer as above.
   Atlas: Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_wall_laplacian(sph_kernel k, int dim, sph_cloud cloud, sph_wall_terms wall,
                                    sph_scalars f, sph_scalar_out out)
{
    int error = sphi_check_wall(k, dim, cloud, wall);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error) error = sphi_check_vectors("wall.slope", dim, wall.slope, cloud.last);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++)
        failed +=
            sphi_store(out, i,
                       sph_wall_laplacian_value(dim, sphi_brookshaw_sum(k, dim, cloud, f, i),
                                                sphi_vector_at(dim, wall.slope, i), sphi_at(wall.gamma, i),
                                                sphi_vector_at(dim, wall.gradient, i)));
    return failed;
}

/* The same Laplacian as rows, for an f that is not known yet:
       lap f_i = sum_p row[p] (f_j - f_i) + source_i,
   with row[p] = -2 V_j F_ij / gamma_i >= 0, factor 1 and conditioning 1, and
   source_i = -2 g_w . grad gamma_i / gamma_i. Answers as above; the status of out is written, that of source
   is not. */
SPH_FN sph_index sph_wall_laplacian_rows(sph_kernel k, int dim, sph_cloud cloud, sph_wall_terms wall,
                                         sph_rows_out out, sph_scalar_out source)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT row = out.row;
    const sph_vec none = {SPH_R(0), SPH_R(0), SPH_R(0)};
    int error = sphi_check_wall(k, dim, cloud, wall);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("wall.slope", dim, wall.slope, cloud.last);
    if (!error && !row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (!error && !source.p) error = sphi_refuse("source", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), nabla = sphi_vector_at(dim, wall.gradient, i);
        const sph_real h_i = sphi_at(cloud.h, i), gamma = sphi_at(wall.gamma, i);
        sph_real value =
            sph_wall_laplacian_value(dim, SPH_R(0), sphi_vector_at(dim, wall.slope, i), gamma, nabla);
        int lost;
        SPH_EACH(p, cloud.list.start[i], cloud.list.start[i + 1]) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            row[p] = sph_wall_laplacian_value(
                dim,
                sph_laplacian_weight_brookshaw(k, dim, sph_length(dim, x_ij), h_i, sphi_at(cloud.volume, j)),
                none, gamma, nabla);
        }
        lost = sphi_row_finite(row, cloud.list.start[i], cloud.list.start[i + 1]) | !sphi_finite(value);
        for (p = cloud.list.start[i]; lost && p < cloud.list.start[i + 1]; p++) row[p] = SPH_R(0);
        source.p[(size_t)i * sphi_stride(source.stride)] = lost ? SPH_R(0) : value;
        sphi_row_answer(out, cloud.list, i, 1, SPH_R(1), lost ? (int)SPH_NOT_FINITE : (int)SPH_OK);
        failed += lost;
    }
    return failed;
}

/* ================================================================ collisions
 *
 * Two particles that are closer than a collision distance exchange an impulse along the line between them,
 * as two balls of restitution C_R do (0 inelastic, 1 elastic). With the inverse masses w = 1/m, so that a
 * wall has w = 0, the velocity of i changes by
 *     dv_i = -(1 + C_R) w_i / (w_i + w_j) (v_ij . e) e,   e = x_ij / r.
 * m_i dv_i = -m_j dv_j, so that momentum and angular momentum are conserved exactly. A single pair loses
 * the energy mu (1 - C_R^2) (v_ij . e)^2 / 2 with mu = 1 / (w_i + w_j).
 *
 * Source: Korzilius, Schilders & Anthonissen, section IV. Their (4.20) sums this over all pairs at once,
 * also over those that recede. Particles then stick together, and the energy grows without bounds
 * (tests/test_collisions.c). Here, only pairs that approach collide: one after the other (sequential), or
 * at once with the weight 1 / max(n_i, n_j), where n is the number of collisions of a particle. Neither
 * form gains energy for C_R <= 1.
 */

/* -------- collisions: types and pair functions */

/* Two particles that collide: their inverse masses (0: a wall), vx = v_ij . x_ij < 0, and the square
   of their distance. */
typedef struct sph_impact {
    sph_real w_i, w_j, vx, r2;
} sph_impact;

/* The coefficient -(1 + restitution) w_i / (w_i + w_j) vx / r^2 of dv_i = coefficient x_ij. It is positive
   where particles approach. Needs restitution >= 0, w_i >= 0, w_j >= 0, w_i + w_j > 0 (two walls do not
   move) and r^2 > 0 (else there is no direction). */
SPH_FN sph_real sph_collision_pair(sph_real restitution, sph_impact c)
{
    SPH_ASSERT(restitution >= SPH_R(0) && c.w_i >= SPH_R(0) && c.w_j >= SPH_R(0) &&
               c.w_i + c.w_j > SPH_R(0) && c.r2 > SPH_R(0));
    return -(SPH_R(1) + restitution) * (c.w_i / (c.w_i + c.w_j)) * c.vx / c.r2;
}

/* -------- collisions: sweeps */

/* Which particles collide, and how. Lists must reach as far as the collision distance. Walls may be mere
   sources, not targets. */
typedef struct sph_collision {
    /* Particles that approach within `distance` collide. restitution: C_R (0 inelastic, 1 elastic). */
    sph_real distance, restitution;
    sph_scalars inverse_mass; /* 1/m of each particle; 0 for walls */
} sph_collision;
SPH_FN sph_impact sphi_impact(sph_real w_i, sph_real w_j, sph_real vx, sph_real r2)
{
    sph_impact c;
    c.w_i = w_i;
    c.w_j = w_j;
    c.vx = vx;
    c.r2 = r2;
    return c;
}
SPH_FN int sphi_check_collisions(int dim, sph_cloud cloud, sph_collision collision)
{
    const sph_real distance = collision.distance, restitution = collision.restitution;
    const sph_scalars inverse_mass = collision.inverse_mass;
    int error;
    if (!sphi_finite(distance) || !(distance > SPH_R(0))) return sphi_refuse("distance", -1, SPH_ERROR_H);
    if (!sphi_finite(restitution) || restitution < SPH_R(0))
        return sphi_refuse("restitution", -1, SPH_ERROR_VALUE);
    error = sphi_check_list(dim, cloud, distance);
    return error ? error : sphi_check_not_negative("inverse_mass", inverse_mass, cloud.points.n);
}
/* Do two particles collide? 0: no; 1: yes; -1: they coincide (closer than 1e-12 of the distance), and
   there is no direction. */
SPH_FN int sphi_collides(sph_real r2, sph_real distance, sph_real vx)
{
    if (!(r2 < distance * distance)) return 0;
    if (!(r2 > SPH_R(1e-24) * distance * distance)) return -1;
    return vx < SPH_R(0);
}

#if !SPH_OPENCL
/* What happened in a sequence of collisions. */
typedef struct sph_collision_report {
    int64_t collisions, coincident; /* numbers of pairs; coincident pairs exchange nothing */
    sph_real energy; /* change of the kinetic energy (walls have none); <= 0 for restitution <= 1 */
} sph_collision_report;

/* Collisions one after the other, in the order of rows and lists. Each takes the velocities that the one
   before left. This is the only sweep that writes beyond its targets: it changes the velocities of
   sources, too, if they are not walls. So never run it on two ranges at once. Each pair collides once,
   also if both rows name it. Full lists, or lists with j > i only. Momentum and angular momentum are
   conserved to round-off, and the energy never grows for restitution <= 1. out may be null. Returns the
   number of pairs whose velocities or energy would overflow (they exchange nothing; 0: none), or a
   negative sph_error.
   Atlas: keeps momentum and angular momentum; energy never grows. */
SPH_FN sph_index sph_collision_sequential(int dim, sph_cloud cloud, sph_collision collision,
                                          sph_vector_out velocity, sph_collision_report *out)
{
    const sph_real distance = collision.distance, restitution = collision.restitution;
    const sph_scalars inverse_mass = collision.inverse_mass;
    sph_real *const vx = velocity.x, *const vy = velocity.y, *const vz = velocity.z;
    const size_t stride = velocity.stride ? velocity.stride : 1;
    int error = sphi_check_collisions(dim, cloud, collision);
    sph_collision_report r;
    sph_index i, p, lost = 0;
    r.collisions = r.coincident = 0;
    r.energy = SPH_R(0);
    if (!error) error = sphi_check_out("velocity", dim, velocity);
    if (!error && SPH_CHECK) {
        sph_vectors v;
        v.x = sph_scalars_strided(vx, stride);
        v.y = sph_scalars_strided(vy, stride);
        v.z = sph_scalars_strided(vz, stride);
        error = sphi_check_vectors("v", dim, v, cloud.points.n);
    }
    if (error >= 0 && out) *out = r;
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real w_i = sphi_at(inverse_mass, i);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const size_t a = (size_t)i * stride, b = (size_t)j * stride;
            const sph_real w_j = sphi_at(inverse_mass, j);
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_real r2 = sph_dot(dim, x_ij, x_ij);
            sph_real c, d, energy, v = (vx[a] - vx[b]) * x_ij.x;
            int what;
            if (j < i && j >= cloud.first) continue; /* the row of j has treated this pair */
            if (dim > 1) v += (vy[a] - vy[b]) * x_ij.y;
            if (dim > 2) v += (vz[a] - vz[b]) * x_ij.z;
            what = w_i + w_j > SPH_R(0) ? sphi_collides(r2, distance, v) : 0;
            r.coincident += what < 0;
            if (what <= 0) continue;
            c = sph_collision_pair(restitution, sphi_impact(w_i, w_j, v, r2));
            d = sph_collision_pair(restitution, sphi_impact(w_j, w_i, v, r2));
            energy =
                r.energy - SPH_R(0.5) * (SPH_R(1) - restitution * restitution) / (w_i + w_j) * v * v / r2;
            if (!sphi_finite(energy) || !sphi_finite(vx[a] + c * x_ij.x) ||
                !sphi_finite(vx[b] - d * x_ij.x) ||
                (dim > 1 && (!sphi_finite(vy[a] + c * x_ij.y) || !sphi_finite(vy[b] - d * x_ij.y))) ||
                (dim > 2 && (!sphi_finite(vz[a] + c * x_ij.z) || !sphi_finite(vz[b] - d * x_ij.z)))) {
                lost++;
                continue;
            }
            r.energy = energy;
            vx[a] += c * x_ij.x;
            vx[b] -= d * x_ij.x;
            if (dim > 1) {
                vy[a] += c * x_ij.y;
                vy[b] -= d * x_ij.y;
            }
            if (dim > 2) {
                vz[a] += c * x_ij.z;
                vz[b] -= d * x_ij.z;
            }
            r.collisions++;
        }
    }
    if (out) *out = r;
    return lost;
}
#endif

/* count[i] is the number of collisions of target i: the first half of the simultaneous form. Full lists. A
   host with halo particles exchanges these numbers before the second half. Returns the number of targets
   that coincide with a neighbour (they do not collide with it), or a negative sph_error. */
SPH_FN sph_index sph_collision_count(int dim, sph_cloud cloud, sph_collision collision, sph_vectors v,
                                     SPH_GLOBAL sph_index *count)
{
    const sph_real distance = collision.distance;
    const sph_scalars inverse_mass = collision.inverse_mass;
    int error = sphi_check_collisions(dim, cloud, collision);
    sph_index i, p, coincident = 0;
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error && !count) error = sphi_refuse("count", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, v, i);
        sph_index n = 0, same = 0;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const int what =
                sphi_collides(sph_dot(dim, x_ij, x_ij), distance,
                              sph_dot(dim, sph_subtract(dim, v_i, sphi_vector_at(dim, v, j)), x_ij));
            if (!(sphi_at(inverse_mass, i) + sphi_at(inverse_mass, j) > SPH_R(0))) continue;
            n += what > 0;
            same |= what < 0;
        }
        count[i] = n;
        coincident += same;
    }
    return coincident;
}

/* The change of velocity of each target by all its collisions at once, each with the weight 1 / max(n_i,
   n_j): the second half. The host adds it to v. count comes from sph_collision_count, for the targets and
   for the sources that are not walls. Full lists. The result does not depend on the order, and ranges may
   run in parallel. Momentum and angular momentum are conserved to round-off, and the energy never grows
   for restitution <= 1 (a particle in n > 1 collisions loses some energy also at 1). Returns the number of
   targets whose result overflowed (it is 0 then), or a negative sph_error.
   Atlas: keeps momentum and angular momentum; energy never grows. */
SPH_FN sph_index sph_collision_change_weighted(int dim, sph_cloud cloud, sph_collision collision,
                                               sph_vectors v, const SPH_GLOBAL sph_index *count,
                                               sph_vector_out change)
{
    const sph_real distance = collision.distance, restitution = collision.restitution;
    const sph_scalars inverse_mass = collision.inverse_mass;
    int error = sphi_check_collisions(dim, cloud, collision);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error) error = sphi_check_out("change", dim, change);
    if (!error && !count) error = sphi_refuse("count", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, v, i);
        const sph_real w_i = sphi_at(inverse_mass, i);
        sph_vec sum = sph_scale(SPH_R(0), x_i);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sph_real w_j = sphi_at(inverse_mass, j);
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          v_ij = sph_subtract(dim, v_i, sphi_vector_at(dim, v, j));
            const sph_real r2 = sph_dot(dim, x_ij, x_ij), vx = sph_dot(dim, v_ij, x_ij);
            sph_index n_i, n_j;
            sph_real c;
            if (!(w_i + w_j > SPH_R(0)) || sphi_collides(r2, distance, vx) <= 0) continue;
            n_i = w_i > SPH_R(0) ? count[i] : 1; /* a wall takes any number of impulses */
            n_j = w_j > SPH_R(0) ? count[j] : 1;
            c = sph_collision_pair(restitution, sphi_impact(w_i, w_j, vx, r2));
            c /= (sph_real)(n_i > n_j ? n_i : n_j > 1 ? n_j : 1);
            sum = sph_subtract(dim, sum, sph_scale(-c, x_ij));
        }
        failed += sphi_store_vector(dim, change, i, sum);
    }
    return failed;
}

/* ================================================================ gas
 *
 * Compressible gas whose smoothing length follows its density. With grad_i W_ij = F x_ij, F_i = F(r, h_i) and
 * Omega of sph_density_adaptive (1 for a constant h) we write
 *     g_i = F_i / (Omega_i rho_i^2),   g_j = F_j / (Omega_j rho_j^2),
 *     G   = (F_i / Omega_i + F_j / Omega_j) / 2,   w = v_ij . x_ij / r,
 * and rho for the mean of the two densities. F, g and G are <= 0. Then, with Pi = alpha v_sig |w| / rho where
 * particles approach, else 0, and v_sig = (c_i + c_j + beta |w|) / 2,
 *     a_i     = -sum_j m_j (P_i g_i + P_j g_j + Pi G) x_ij,
 *     du_i/dt = P_i sum_j m_j g_i v_ij . x_ij + sum_j m_j G r (Pi w / 2 + alpha_u v_u (u_i - u_j) / rho).
 * Momentum, angular momentum and energy, sum m (v^2 / 2 + u), are conserved to round-off. Viscosity only
 * heats. The last term, artificial conductivity, carries heat from the hotter to the colder particle where a
 * contact would otherwise be a jump of P: alpha_u = 1 is usual. Its speed is a choice, and no choice is right
 * everywhere:
 *     none      P has a blip at each contact: 11 % in Sod's tube.
 *     Price     v_u = sqrt(|P_i - P_j| / rho): 3.4 % there. But it conducts wherever P has a gradient, and so
 *               also in a star or an atmosphere at rest. Price 2008, JCP 227, 10040.
 *     Wadsley   v_u = |w|: 7 % there, and exactly nothing at rest: with gravity take this one. Wadsley,
 *               Veeravalli & Couchman 2008, MNRAS 387, 427; Price et al. 2018, PASA 35, e031.
 *
 * The order of a step: density, h and Omega from positions (sph_density_adaptive), then P and c from density
 * and u, then sph_gas_rates. All rates belong to one instant: v and u must be those of the positions. Stages
 * of Runge-Kutta's kind have them. In kick-drift-kick, where v is half a step behind x, predict them from
 * their last rates: otherwise du/dt does not balance the work of the forces, and the energy of Sod's tube is
 * wrong by 1e-3 instead of 1e-5.
 *
 * alpha = 1 for shocks is far too much for flows without them. What makes it smaller, each particle having
 * its own alpha (a pair takes the mean):
 *     Balsara's factor f in [0, 1] leaves shear alone: pass alpha f_i. No memory.
 *     Morris & Monaghan: alpha follows -div v, and decays behind the shock (sph_viscosity_switch_rate).
 *     Cullen & Dehnen: alpha rises at once ahead of the shock, where -d(div v)/dt is large, to
 *         alpha_loc = most h^2 A / (v_sig^2 + h^2 A),   A = xi max(-d(div v)/dt, 0),
 *     and decays behind it: sph_velocity_gradient_cspm, sph_shock_indicator, then functions of values.
 *     Phantom: the same with alpha_loc = min(10 h^2 A / c^2, most) and a xi without sums.
 * In Sod's tube Phantom's form reaches 1 at the shock; that of the paper .8, late, and it rings behind it.
 * d(div v)/dt is the difference of two steps, or without memory div a - tr((grad v)^2), whose second term is
 * `square` of sph_velocity_gradient_cspm, and div a its `div` with accelerations in the place of v.
 *
 * Sources: Springel & Hernquist 2002, MNRAS 333, 649, and Monaghan 2002, MNRAS 335, 843 (Omega); Monaghan
 * 1997, JCP 136, 298 (signal speed); Price 2012, JCP 231, 759; Balsara 1995, JCP 121, 357; Morris & Monaghan
 * 1997, JCP 136, 41; Cullen & Dehnen 2010, MNRAS 408, 669; Price et al. 2018 (Phantom, and its source).
 */

/* -------- gas: the two sides of a pair, and their weights */

/* Mass, density and Omega of one particle. Omega is a pure number, 1 for a constant h. */
typedef struct sph_medium_side {
    sph_real m, rho, omega;
    SPHI_TCC_PAD
} sph_medium_side;
/* The kernel between two particles: their distance r, and F with the h of either, f_i = F(r, h_i) and
   f_j = F(r, h_j). */
typedef struct sph_pair_kernel {
    sph_real r, f_i, f_j;
    SPHI_TCC_PAD
} sph_pair_kernel;
/* The weights of the two sides in the symmetric forms: i = m_j g_i and j = m_j g_j with
   g = F / (Omega rho^2). */
typedef struct sph_pair_weights {
    sph_real i, j;
} sph_pair_weights;

/* 1 / (Omega rho^2), so that g is F times it. Needs rho > 0 and Omega > 0. */
SPH_FN sph_real sph_medium_weight(sph_medium_side a)
{
    SPH_ASSERT(a.rho > SPH_R(0) && a.omega > SPH_R(0));
    return SPH_R(1) / (a.omega * a.rho * a.rho);
}
/* The weights m_j g_i and m_j g_j; weight_i and weight_j come from sph_medium_weight. */
SPH_FN sph_pair_weights sph_pair_weights_of(sph_real m_j, sph_pair_kernel f, sph_real weight_i,
                                            sph_real weight_j)
{
    sph_pair_weights w;
    w.i = m_j * f.f_i * weight_i;
    w.j = m_j * f.f_j * weight_j;
    return w;
}

/* Makes the derivative at i of a sum of difference forms with the weights m_j F_i: -sum / (Omega_i rho_i).
   Needs rho > 0 and Omega > 0. */
SPH_FN sph_real sph_medium_difference(sph_medium_side i, sph_real sum)
{
    SPH_ASSERT(i.rho > SPH_R(0) && i.omega > SPH_R(0));
    return -sum / (i.omega * i.rho);
}

/* -------- gas: pair functions */

/* Which speed v_u conducts heat, alpha_u v_u (u_i - u_j) / rho. */
typedef enum sph_conductivity {
    SPH_CONDUCTIVITY_NONE,
    SPH_CONDUCTIVITY_PRICE,  /* sph_conductivity_speed: differences of pressure */
    SPH_CONDUCTIVITY_WADSLEY /* |w|: nothing at rest, so that it may be used with gravity */
} sph_conductivity;

/* The signal speed of the artificial conductivity: sqrt(|P_i - P_j| / rho). per_rho is 1 over the mean
   density. Price 2008, JCP 227, 10040. Needs per_rho >= 0. */
SPH_FN sph_real sph_conductivity_speed(sph_real P_i, sph_real P_j, sph_real per_rho)
{
    SPH_ASSERT(per_rho >= SPH_R(0));
    return SPHI_SQRT(SPHI_ABS(P_i - P_j) * per_rho);
}
SPH_FN sph_real sphi_conduction(int conductivity, sph_real alpha_u, sph_real P_i, sph_real P_j, sph_real u_ij,
                                sph_real w, sph_real per_rho)
{
    if (conductivity == (int)SPH_CONDUCTIVITY_NONE) return SPH_R(0);
    return alpha_u *
           (conductivity == (int)SPH_CONDUCTIVITY_PRICE ? sph_conductivity_speed(P_i, P_j, per_rho)
                                                        : SPHI_ABS(w)) *
           u_ij * per_rho;
}
/* What a pair has in common, with a field or without: the weights, m_j G, m_j F_i, 1 / rho of either side and
   of the mean density, and 1 / r. One division for each side gives 1 / rho and 1 / Omega. */
typedef struct sphi_meeting {
    sph_pair_weights g;
    sph_real mean_f, weight, per_rho_i, per_rho_j, per_rho, per_r;
} sphi_meeting;
SPH_FN sphi_meeting sphi_meet(sph_medium_side i, sph_medium_side j, sph_pair_kernel f)
{
    const sph_real both_i = SPH_R(1) / (i.omega * i.rho), both_j = SPH_R(1) / (j.omega * j.rho);
    sphi_meeting e;
    e.per_rho_i = i.omega * both_i;
    e.per_rho_j = j.omega * both_j;
    e.g = sph_pair_weights_of(j.m, f, e.per_rho_i * both_i, e.per_rho_j * both_j);
    e.mean_f = SPH_R(0.5) * (j.m * f.f_i * (i.rho * both_i) + j.m * f.f_j * (j.rho * both_j));
    e.weight = j.m * f.f_i;
    e.per_rho = SPH_R(2) / (i.rho + j.rho);
    e.per_r = SPH_R(1) / (f.r + SPHI_TINY);
    return e;
}
/* The coefficient of -x_ij in the acceleration, m_j Pi G, and du/dt by viscosity and conductivity. */
typedef struct sphi_dissipation {
    sph_real push, heat;
} sphi_dissipation;
SPH_FN sphi_dissipation sphi_dissipate(sphi_meeting e, sph_real r, sph_real w, sph_real alpha_speed,
                                       sph_real conduction)
{
    const sph_real viscosity = sph_viscosity_signal(alpha_speed, w, e.per_rho);
    sphi_dissipation d;
    d.push = viscosity * e.mean_f;
    d.heat = e.mean_f * r * (SPH_R(0.5) * viscosity * w + conduction);
    return d;
}

/* The values of one particle: pressure, thermal energy per mass, sound speed, coefficient of viscosity. */
typedef struct sph_gas_side {
    sph_medium_side medium;
    sph_real p, u, cs, alpha;
    sph_vec v;
} sph_gas_side;
/* What is the same for all pairs: beta of the signal speed, usually 2, alpha_u of conductivity, usually 1,
   and which conductivity. */
typedef struct sph_gas_terms {
    sph_real beta, alpha_u;
    int conductivity;
} sph_gas_terms;
/* What j adds to the sums of particle i, or these sums. force: the acceleration. div_v: the sum of the
   difference form, before sph_medium_difference. heat: du/dt by viscosity and conductivity. speed: the signal
   speed of the pair; of the sums, the largest. sph_gas_value makes rates of them; it does not read speed. */
typedef struct sph_gas_sums {
    sph_vec force;
    sph_real div_v, heat, speed;
} sph_gas_sums;
/* The whole interaction of a pair: what j adds to i. See the beginning of this chapter. Needs rho > 0 and
   Omega > 0 on both sides. */
SPH_FN sph_gas_sums sph_gas_pair(int dim, sph_gas_terms terms, sph_gas_side i, sph_gas_side j,
                                 sph_pair_kernel f, sph_vec x_ij)
{
    const sphi_meeting e = sphi_meet(i.medium, j.medium, f);
    const sph_real vx = sph_dot(dim, sph_subtract(dim, i.v, j.v), x_ij), w = vx * e.per_r,
                   speed = sph_signal_speed(i.cs, j.cs, terms.beta * SPHI_ABS(w));
    const sphi_dissipation lost =
        sphi_dissipate(e, f.r, w, SPH_R(0.5) * (i.alpha + j.alpha) * speed,
                       sphi_conduction(terms.conductivity, terms.alpha_u, i.p, j.p, i.u - j.u, w, e.per_rho));
    sph_gas_sums c;
    SPH_ASSERT(SPHI_IS_DIM(dim) && f.r >= SPH_R(0) && i.medium.rho > SPH_R(0) && i.medium.omega > SPH_R(0) &&
               j.medium.rho > SPH_R(0) && j.medium.omega > SPH_R(0));
    c.force = sph_scale(-(i.p * e.g.i + j.p * e.g.j + lost.push), x_ij);
    c.div_v = e.weight * vx;
    c.heat = lost.heat;
    c.speed = speed;
    return c;
}
/* The rates of a particle: dv/dt and du/dt, and div v in difference form. */
typedef struct sph_gas_change {
    sph_vec acceleration;
    sph_real rate_u, div_v;
} sph_gas_change;
/* P_i / (Omega_i rho_i^2) sum_j m_j F_i v_ij . x_ij, the work of the pressure in du/dt. div_v is this sum, as
   in sph_gas_sums. Needs rho > 0 and Omega > 0. */
SPH_FN sph_real sph_gas_work(sph_medium_side i, sph_real P_i, sph_real div_v)
{
    return P_i * sph_medium_weight(i) * div_v;
}
/* The rates of particle i from its sums. Needs rho > 0 and Omega > 0. */
SPH_FN sph_gas_change sph_gas_value(sph_gas_side i, sph_gas_sums s)
{
    sph_gas_change c;
    c.acceleration = s.force;
    c.rate_u = sph_gas_work(i.medium, i.p, s.div_v) + s.heat;
    c.div_v = sph_medium_difference(i.medium, s.div_v);
    return c;
}

/* -------- gas: the gradient of the velocity; functions of values */

/* The gradients of v_x, v_y and v_z: the derivative of v_x along y is x.y. */
typedef struct sph_velocity_gradient {
    sph_vec x, y, z;
} sph_velocity_gradient;
/* What a switch needs of it: div v; curl = |curl v|; shear = S : S, the sum of the squares of the nine
   components of S = (grad v + (grad v)^T) / 2 - div v / dim; square = tr((grad v)^2), which obeys
   d(div v)/dt = div a - square along the motion. */
typedef struct sph_flow {
    sph_real div, curl, shear, square;
} sph_flow;
/* These numbers from the gradient. */
SPH_FN sph_flow sph_flow_of(int dim, sph_velocity_gradient g)
{
    const sph_real mean = (g.x.x + (dim > 1 ? g.y.y : SPH_R(0)) + (dim > 2 ? g.z.z : SPH_R(0))) / SPH_R(dim);
    sph_flow f;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    f.div = SPH_R(dim) * mean;
    f.curl = SPH_R(0);
    f.shear = (g.x.x - mean) * (g.x.x - mean);
    f.square = g.x.x * g.x.x;
    if (dim > 1) {
        const sph_real turn = g.y.x - g.x.y, slide = g.y.x + g.x.y;
        f.curl = turn * turn;
        f.shear += (g.y.y - mean) * (g.y.y - mean) + SPH_R(0.5) * slide * slide;
        f.square += g.y.y * g.y.y + SPH_R(2) * g.x.y * g.y.x;
    }
    if (dim > 2) {
        const sph_real turn_x = g.z.y - g.y.z, turn_y = g.x.z - g.z.x, slide_x = g.z.y + g.y.z,
                       slide_y = g.x.z + g.z.x;
        f.curl += turn_x * turn_x + turn_y * turn_y;
        f.shear += (g.z.z - mean) * (g.z.z - mean) + SPH_R(0.5) * (slide_x * slide_x + slide_y * slide_y);
        f.square += g.z.z * g.z.z + SPH_R(2) * (g.x.z * g.z.x + g.y.z * g.z.y);
    }
    f.curl = SPHI_SQRT(f.curl);
    return f;
}
/* What j adds to the gradient: weight e (v_j - v_i) for each component, where e = x_j - x_i and v_ji is that
   difference. weight = sph_moment_weight_gradient, with V_j, or with m_j for the difference form. */
SPH_FN sph_velocity_gradient sph_velocity_gradient_pair(sph_real weight, sph_vec v_ji, sph_vec e)
{
    sph_velocity_gradient c;
    c.x = sph_scale(weight * v_ji.x, e);
    c.y = sph_scale(weight * v_ji.y, e);
    c.z = sph_scale(weight * v_ji.z, e);
    return c;
}

/* -------- gas: switches of the viscosity; functions of values */

/* Balsara's factor: |div v| / (|div v| + |curl v| + 1e-4 c / h), 1 in pure compression, 0 in pure shear.
   The viscosity of a pair is multiplied by the mean of the two factors, as in GADGET, if alpha f_i is passed
   for alpha_i. (Others take the product.) Balsara 1995. Needs cs >= 0 and h > 0. */
SPH_FN sph_real sph_viscosity_factor_balsara(sph_flow f, sph_real cs, sph_real h)
{
    const sph_real div = SPHI_ABS(f.div);
    SPH_ASSERT(f.curl >= SPH_R(0) && cs >= SPH_R(0) && h > SPH_R(0));
    return div / (div + f.curl + SPH_R(1e-4) * cs / h + SPHI_TINY);
}
/* The present value of a switch, and its bounds. */
typedef struct sph_switch {
    sph_real alpha, least, most;
} sph_switch;

/* dalpha/dt of the viscosity switch: (least - alpha) 0.1 v_sig / h + max(-div v, 0) (most - alpha). Morris
   & Monaghan 1997, JCP 136, 41. Needs least <= most and v_sig >= 0. */
SPH_FN sph_real sph_viscosity_switch_rate(sph_switch s, sph_real v_sig, sph_real h, sph_real div_v)
{
    SPH_ASSERT(s.least <= s.most && v_sig >= SPH_R(0) && h > SPH_R(0));
    return (s.least - s.alpha) * SPH_R(0.1) * v_sig / h +
           SPH_R(0.5) * (SPHI_ABS(div_v) - div_v) * (s.most - s.alpha);
}
/* What j adds to the sum of R: sign(div_j) m_j W_ij, div_j being div v there; sign(0) = 0. */
SPH_FN sph_real sph_shock_pair(sph_real m_j, sph_real div_j, sph_real w_ij)
{
    return div_j / (SPHI_ABS(div_j) + SPHI_TINY) * m_j * w_ij;
}
/* R = sum / rho, in [-1, 1] if rho is the sum of m_j W_ij: -1 where all around is compressed, which a noisy
   div v is not. Needs rho > 0. */
SPH_FN sph_real sph_shock_value(sph_real sum, sph_real rho)
{
    SPH_ASSERT(rho > SPH_R(0));
    return sum / rho;
}
/* xi = |2 (1 - R)^4 div v|^2 / (|2 (1 - R)^4 div v|^2 + S : S), in [0, 1]: 1 in pure compression, 0 in pure
   shear, and near 0 where all around expands. ratio is R of sph_shock_value. Where both terms are 0 it is 1,
   unless div v > 0. Cullen & Dehnen 2010. */
SPH_FN sph_real sph_shock_factor_cullen_dehnen(sph_flow f, sph_real ratio)
{
    const sph_real b = (SPH_R(1) - ratio) * (SPH_R(1) - ratio), a = SPH_R(2) * b * b * f.div, squeeze = a * a,
                   sum = squeeze + f.shear;
    SPH_ASSERT(f.shear >= SPH_R(0));
    return sum > SPH_R(0) ? squeeze / sum : f.div > SPH_R(0) ? SPH_R(0) : SPH_R(1);
}
/* xi = d^2 / (d^2 + |curl v|^2) with d = max(-div v, 0), and 1 where both are 0, thus always in 1D:
   Phantom's, which needs no sum. Price et al. 2018. */
SPH_FN sph_real sph_shock_factor_phantom(sph_flow f)
{
    const sph_real d = SPH_R(0.5) * (SPHI_ABS(f.div) - f.div), sum = d * d + f.curl * f.curl;
    SPH_ASSERT(f.curl >= SPH_R(0));
    return sum > SPH_R(0) ? d * d / sum : SPH_R(1);
}
/* A shock at a particle: rate = d(div v)/dt, factor = xi, smoothing length, sound speed, signal speed. */
typedef struct sph_shock {
    sph_real rate, factor, h, cs, v_sig;
} sph_shock;
#define SPHI_IS_SHOCK(s) \
    ((s).factor >= SPH_R(0) && (s).h > SPH_R(0) && (s).cs >= SPH_R(0) && (s).v_sig >= SPH_R(0))
/* h^2 A with A = xi max(-d(div v)/dt, 0). */
SPH_FN sph_real sphi_shock_source(sph_shock s)
{
    return s.h * s.h * s.factor * SPH_R(0.5) * (SPHI_ABS(s.rate) - s.rate);
}
/* The least or more: a value of a switch is not below its bound. */
SPH_FN sph_real sphi_switch_value(sph_switch s, sph_real alpha) { return alpha > s.least ? alpha : s.least; }
/* alpha_loc = most h^2 A / (v_sig^2 + h^2 A), and not below least. The paper has least = 0, most = 2 and
   v_sig of sph_shock_indicator. cs is not read. Cullen & Dehnen 2010. Needs least <= most. */
SPH_FN sph_real sph_viscosity_target_cullen_dehnen(sph_switch s, sph_shock shock)
{
    const sph_real a = sphi_shock_source(shock);
    SPH_ASSERT(s.least <= s.most && SPHI_IS_SHOCK(shock));
    return sphi_switch_value(s, s.most * (a / (shock.v_sig * shock.v_sig + a + SPHI_TINY)));
}
/* alpha_loc = min(10 h^2 A / c^2, most), and not below least: as Phantom has it, with least = 0 and most = 1.
   v_sig is not read. With c = 0 it is most where A > 0. Price et al. 2018 and Phantom's source, which leaves
   A out of the denominator. Needs least <= most. */
SPH_FN sph_real sph_viscosity_target_phantom(sph_switch s, sph_shock shock)
{
    const sph_real a = SPH_R(10) * sphi_shock_source(shock), c2 = shock.cs * shock.cs;
    SPH_ASSERT(s.least <= s.most && SPHI_IS_SHOCK(shock));
    return sphi_switch_value(s, a < s.most * c2 ? a / c2 : a > SPH_R(0) ? s.most : SPH_R(0));
}
/* alpha after a step dt: the target alpha_loc where that is larger, else alpha decays to it,
   d alpha/dt = (alpha_loc - alpha) / tau with tau = 10 h / v_sig (l = 0.05), for which the answer is exact if
   target and v_sig are constant. Of shock, h and v_sig are read. Cullen & Dehnen 2010. Needs dt >= 0. */
SPH_FN sph_real sph_viscosity_switch_after(sph_switch s, sph_shock shock, sph_real target, sph_real dt)
{
    SPH_ASSERT(shock.h > SPH_R(0) && shock.v_sig >= SPH_R(0) && dt >= SPH_R(0));
    if (!(target < s.alpha)) return target;
    return target + (s.alpha - target) * SPHI_EXP(SPH_R(-0.1) * dt * shock.v_sig / shock.h);
}

/* -------- gas: sweeps
   Lists must hold all pairs with r < support ratio * max(h_i, h_j) (SPH_LARGER). rho and Omega come from
   sph_density_adaptive; with a constant h take any density, and sph_scalars_same(&one) for Omega. Sweeps
   return the number of targets of which a result overflowed (it is 0 then), or a negative sph_error. */

/* Mass, density and Omega of all sources. Difference forms and sph_shock_indicator read the last two of the
   targets. */
typedef struct sph_medium {
    sph_scalars m, rho, omega;
} sph_medium;
/* n: of how many particles rho and Omega are read; difference forms read those of the targets only. */
SPH_FN int sphi_check_medium(sph_kernel k, int dim, sph_cloud cloud, sph_medium g, sph_index n)
{
    int error = sphi_check_sweep(k, dim, cloud, "m", g.m);
    if (!error) error = sphi_check_positive("rho", g.rho, n);
    return error ? error : sphi_check_positive("omega", g.omega, n);
}
SPH_FN sph_medium_side sphi_medium_side(const sph_medium *g, sph_index i)
{
    sph_medium_side a;
    a.m = sphi_at(g->m, i);
    a.rho = sphi_at(g->rho, i);
    a.omega = sphi_at(g->omega, i);
    return a;
}
SPH_FN sph_pair_kernel sphi_pair_kernel(sph_kernel k, int dim, int uniform, sph_vec x_ij, sph_real h_i,
                                        sph_scalars h, sph_index j)
{
    sph_pair_kernel f;
    f.r = sph_length(dim, x_ij);
    f.f_i = sph_kernel_f(k, dim, f.r, h_i);
    f.f_j = uniform ? f.f_i : sph_kernel_f(k, dim, f.r, sphi_at(h, j));
    return f;
}
/* 1 within the larger of the two supports, 0 beyond it. A comparison would keep gcc from vectorising. */
SPH_FN sph_real sphi_within(sph_real support, sph_real h_i, sph_real h_j, sph_real r)
{
    return SPH_R(0.5) +
           SPHI_COPYSIGN(SPH_R(0.5), support * SPH_R(0.5) * (h_i + h_j + SPHI_ABS(h_i - h_j)) - r);
}
/* The largest of `most` and n numbers. A block has as many maxima as numbers, because a single maximum would
   wait for itself in every pass. */
SPH_FN sph_real sphi_largest(sph_real most, const sph_real *of, int n)
{
    sph_real lane[SPHI_BLOCK];
    int p, l;
    for (l = 0; l < SPHI_BLOCK; l++) lane[l] = most;
    for (p = 0; p + SPHI_BLOCK <= n; p += SPHI_BLOCK)
        for (l = 0; l < SPHI_BLOCK; l++) lane[l] = of[p + l] > lane[l] ? of[p + l] : lane[l];
    for (; p < n; p++) most = of[p] > most ? of[p] : most;
    for (l = 0; l < SPHI_BLOCK; l++) most = lane[l] > most ? lane[l] : most;
    return most;
}

/* The state of a gas, one number or vector for each particle, all sources. */
typedef struct sph_gas {
    sph_medium medium;
    sph_scalars p, u, cs; /* pressure, thermal energy per mass, sound speed >= 0 */
    sph_scalars alpha;    /* coefficient of viscosity, 0 (none) to 1 or more. A pair takes the mean */
    sph_vectors v;
    sph_real beta, alpha_u; /* of signal speed and conductivity; 2 and 1 are usual */
    int conductivity;       /* which: an sph_conductivity. With SPH_CONDUCTIVITY_NONE alpha_u is not read */
} sph_gas;
/* Where rates go. acceleration must be there; the other pointers may be null. */
typedef struct sph_gas_out {
    sph_vector_out acceleration;
    SPH_GLOBAL sph_real *rate_u, *div_v, *v_sig; /* du/dt, div v in difference form, largest signal speed */
    size_t stride;                               /* of these three, in sph_real; 0 counts as 1 */
    SPH_GLOBAL unsigned char *status;
} sph_gas_out;

SPH_FN sph_gas_side sphi_gas_side(int conducts, int dim, const sph_gas *s, sph_index i)
{
    sph_gas_side a;
    a.medium = sphi_medium_side(&s->medium, i);
    a.p = sphi_at(s->p, i);
    a.u = conducts ? sphi_at(s->u, i) : SPH_R(0);
    a.cs = sphi_at(s->cs, i);
    a.alpha = sphi_at(s->alpha, i);
    a.v = sphi_vector_at(dim, s->v, i);
    return a;
}
SPH_FN sph_index sphi_gas_range(int uniform, int conductivity, sph_kernel k, int dim, sph_cloud cloud,
                                const sph_gas *s, const sph_gas_out *out)
{
    const sph_real support = sph_kernel_support_ratio(k);
    const size_t stride = sphi_stride(out->stride);
    const int conducts = conductivity != (int)SPH_CONDUCTIVITY_NONE;
    sph_real v_sig[SPHI_TILE];
    sph_gas_terms terms;
    sph_index i, p, tile, end, failed = 0;
    terms.beta = s->beta;
    terms.alpha_u = s->alpha_u;
    terms.conductivity = conductivity;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_gas_side own = sphi_gas_side(conducts, dim, s, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0), div = SPH_R(0), heat = SPH_R(0);
        sph_gas_sums sums;
        sph_gas_change change;
        int lost;
        sums.speed = own.cs;
        for (tile = cloud.list.start[i]; tile < cloud.list.start[i + 1]; tile = end) {
            end = cloud.list.start[i + 1] - tile < SPHI_TILE ? cloud.list.start[i + 1] : tile + SPHI_TILE;
            SPH_SUM(p, tile, end, ax, ay, az, div, heat) {
                const sph_index j = cloud.list.index[p];
                const sph_vec x_ij =
                    sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
                const sph_pair_kernel f = sphi_pair_kernel(k, dim, uniform, x_ij, h_i, cloud.h, j);
                const sph_gas_sums c =
                    sph_gas_pair(dim, terms, own, sphi_gas_side(conducts, dim, s, j), f, x_ij);
                ax += c.force.x;
                if (dim > 1) ay += c.force.y;
                if (dim > 2) az += c.force.z;
                div += c.div_v;
                heat += c.heat;
                v_sig[p - tile] =
                    c.speed * sphi_within(support, h_i, uniform ? h_i : sphi_at(cloud.h, j), f.r);
            }
            sums.speed = sphi_largest(sums.speed, v_sig, (int)(end - tile));
        }
        sums.force.x = ax;
        sums.force.y = ay;
        sums.force.z = az;
        sums.div_v = div;
        sums.heat = heat;
        change = sph_gas_value(own, sums);
        lost = sphi_store_vector(dim, out->acceleration, i, change.acceleration);
        lost |= sphi_put(out->rate_u, stride, i, change.rate_u);
        lost |= sphi_put(out->div_v, stride, i, change.div_v);
        lost |= sphi_put(out->v_sig, stride, i, sums.speed);
        sphi_tell(out->status, i, lost);
        failed += lost;
    }
    return failed;
}
/* Chooses the loop, for which the conductivity and the kind of h are constants. */
SPH_FN sph_index sphi_gas_some(int uniform, sph_kernel k, int dim, sph_cloud cloud, const sph_gas *s,
                               const sph_gas_out *out)
{
    if (s->conductivity == (int)SPH_CONDUCTIVITY_PRICE)
        return sphi_gas_range(uniform, (int)SPH_CONDUCTIVITY_PRICE, k, dim, cloud, s, out);
    if (s->conductivity == (int)SPH_CONDUCTIVITY_WADSLEY)
        return sphi_gas_range(uniform, (int)SPH_CONDUCTIVITY_WADSLEY, k, dim, cloud, s, out);
    return sphi_gas_range(uniform, (int)SPH_CONDUCTIVITY_NONE, k, dim, cloud, s, out);
}
/* Acceleration and du/dt of a gas in one pass, with div v and the largest signal speed: the sums of
   sph_gas_pair. For the equations, their sources and the order of a step see the beginning of this chapter.
   The density comes from sph_density_adaptive; its rate is -rho div v. sum m a = 0, sum m x cross a = 0 and
   sum m (v . a + du/dt) = 0 to round-off, for any h and Omega. v_sig is the largest signal speed of a target
   with its neighbours within the larger of the two supports, for time steps and switches: dt = 0.3 h / v_sig
   is usual. It is not below the target's own sound speed. Gravity is not contained (sph_gravity_direct and
   sph_gravity_correction). The same as sph_mhd_rates with B = 0 and Price's conductivity, in half
   of its time, and in 1.3 to 1.5 times that of sph_fluid_rates_monaghan (tests/bench/README.md). */
SPH_FN sph_index sph_gas_rates(sph_kernel k, int dim, sph_cloud cloud, sph_gas state, sph_gas_out out)
{
    int error = sphi_check_medium(k, dim, cloud, state.medium, cloud.points.n);
    if (!error && (state.conductivity < 0 || state.conductivity > (int)SPH_CONDUCTIVITY_WADSLEY))
        error = sphi_refuse("state.conductivity", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_field("p", state.p, cloud.points.n);
    if (!error && state.conductivity != (int)SPH_CONDUCTIVITY_NONE)
        error = sphi_check_field("u", state.u, cloud.points.n);
    if (!error) error = sphi_check_not_negative("cs", state.cs, cloud.points.n);
    if (!error) error = sphi_check_field("alpha", state.alpha, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, state.v, cloud.points.n);
    if (!error && (!sphi_finite(state.beta) || !sphi_finite(state.alpha_u)))
        error = sphi_refuse("state.beta, alpha_u", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_out("acceleration", dim, out.acceleration);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_gas_some(0, k, dim, cloud, &state, &out)
                          : sphi_gas_some(1, k, dim, cloud, &state, &out);
}

/* Where the gradient of the velocity goes, and what a switch needs of it (see sph_flow). Every pointer may be
   null: x, y and z are the gradients of v_x, v_y and v_z, and not wanted where their first array is null. */
typedef struct sph_velocity_gradient_out {
    SPH_GLOBAL sph_real *div, *curl, *shear, *square;
    size_t stride; /* of these four, in sph_real; 0 counts as 1 */
    sph_vector_out x, y, z;
    SPH_GLOBAL unsigned char *status;
} sph_velocity_gradient_out;

/* The rows of a gradient that are wanted must have all their arrays. */
SPH_FN int sphi_check_gradient_out(int dim, sph_velocity_gradient_out out)
{
    int error = 0;
    if (out.x.x) error = sphi_check_out("out.x", dim, out.x);
    if (!error && dim > 1 && out.y.x) error = sphi_check_out("out.y", dim, out.y);
    if (!error && dim > 2 && out.z.x) error = sphi_check_out("out.z", dim, out.z);
    return error;
}
/* Stores the gradient and its flow; 1 if a number is not finite. */
SPH_FN int sphi_store_gradient(int dim, sph_velocity_gradient_out out, sph_index i, sph_velocity_gradient g)
{
    const size_t stride = sphi_stride(out.stride);
    const sph_flow f = sph_flow_of(dim, g);
    int lost = sphi_put(out.div, stride, i, f.div);
    lost |= sphi_put(out.curl, stride, i, f.curl);
    lost |= sphi_put(out.shear, stride, i, f.shear);
    lost |= sphi_put(out.square, stride, i, f.square);
    if (out.x.x) lost |= sphi_store_vector(dim, out.x, i, g.x);
    if (dim > 1 && out.y.x) lost |= sphi_store_vector(dim, out.y, i, g.y);
    if (dim > 2 && out.z.x) lost |= sphi_store_vector(dim, out.z, i, g.z);
    return lost;
}
/* The sums of sph_velocity_gradient_pair over the neighbours of i, and *moment = sum weight e e^T. */
SPH_FN sph_velocity_gradient sphi_velocity_sums(sph_kernel k, int dim, sph_cloud cloud, sph_scalars weights,
                                                sph_vectors v, sph_index i, sph_sym *moment)
{
    const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, v, i);
    const sph_real h_i = sphi_at(cloud.h, i);
    sph_real xx = SPH_R(0), xy = SPH_R(0), xz = SPH_R(0), yx = SPH_R(0), yy = SPH_R(0), yz = SPH_R(0),
             zx = SPH_R(0), zy = SPH_R(0), zz = SPH_R(0);
    sph_real mxx = SPH_R(0), mxy = SPH_R(0), myy = SPH_R(0), mxz = SPH_R(0), myz = SPH_R(0), mzz = SPH_R(0);
    sph_velocity_gradient sum;
    sph_index p;
    SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], xx, xy, xz, yx, yy, yz, zx, zy, zz, mxx, mxy,
            myy, mxz, myz, mzz) {
        const sph_index j = cloud.list.index[p];
        const sph_vec e = sphi_separation(dim, cloud.points, sphi_point(dim, cloud.points, j), x_i);
        const sph_real weight =
            sph_moment_weight_gradient(k, dim, sph_length(dim, e), h_i, sphi_at(weights, j));
        const sph_vec we = sph_scale(weight, e);
        const sph_velocity_gradient c =
            sph_velocity_gradient_pair(weight, sph_subtract(dim, sphi_vector_at(dim, v, j), v_i), e);
        xx += c.x.x;
        mxx += we.x * e.x;
        if (dim > 1) {
            xy += c.x.y;
            yx += c.y.x;
            yy += c.y.y;
            mxy += we.x * e.y;
            myy += we.y * e.y;
        }
        if (dim > 2) {
            xz += c.x.z;
            yz += c.y.z;
            zx += c.z.x;
            zy += c.z.y;
            zz += c.z.z;
            mxz += we.x * e.z;
            myz += we.y * e.z;
            mzz += we.z * e.z;
        }
    }
    sum.x.x = xx;
    sum.x.y = xy;
    sum.x.z = xz;
    sum.y.x = yx;
    sum.y.y = yy;
    sum.y.z = yz;
    sum.z.x = zx;
    sum.z.y = zy;
    sum.z.z = zz;
    moment->xx = mxx;
    moment->xy = mxy;
    moment->yy = myy;
    moment->xz = mxz;
    moment->yz = myz;
    moment->zz = mzz;
    return sum;
}
/* A vector of difference forms, each by sph_medium_difference of what the pairs add with e = -x_ij. */
SPH_FN sph_vec sphi_medium_differences(sph_medium_side i, sph_vec sum)
{
    sum.x = sph_medium_difference(i, -sum.x);
    sum.y = sph_medium_difference(i, -sum.y);
    sum.z = sph_medium_difference(i, -sum.z);
    return sum;
}
/* grad v in difference form, (1 / (Omega_i rho_i)) sum_j m_j (v_j - v_i)_a grad_i W_ij(h_i) for the component
   a, and div v, |curl v|, S : S and tr((grad v)^2) from it. div is that of sph_gas_rates. Exact for constant
   v; the error is O(h^2) in the interior where the particles are regular, down to what h / dx leaves, and
   does not fall in disorder. Price 2012. */
SPH_FN sph_index sph_velocity_gradient_difference(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                                  sph_vectors v, sph_velocity_gradient_out out)
{
    int error = sphi_check_medium(k, dim, cloud, medium, cloud.last);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error) error = sphi_check_gradient_out(dim, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_medium_side own = sphi_medium_side(&medium, i);
        sph_sym moment;
        sph_velocity_gradient g = sphi_velocity_sums(k, dim, cloud, medium.m, v, i, &moment);
        int lost;
        g.x = sphi_medium_differences(own, g.x);
        g.y = sphi_medium_differences(own, g.y);
        g.z = sphi_medium_differences(own, g.z);
        lost = sphi_store_gradient(dim, out, i, g);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}
/* The same, renormalised: the gradients of sph_gradient_cspm of each component, by one sum. Exact for linear
   v at any particle. The cloud's volumes m / rho are read. A target needs dim neighbours inside its support,
   in 2D not all on one line with it, in 3D not all in one plane: else its results are 0, with SPH_TOO_FEW or
   SPH_SINGULAR. Cullen & Dehnen 2010 take this one. Returns the number of targets that are not SPH_OK, or a
   negative sph_error.
   Atlas: divergence exact for linear fields, inside lattices for quadratic fields; order 2 inside lattices,
   1 in disorder, 1 at boundaries. */
SPH_FN sph_index sph_velocity_gradient_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_vectors v,
                                            sph_velocity_gradient_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error) error = sphi_check_gradient_out(dim, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        sph_sym moment, inverse = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)};
        sph_velocity_gradient g = sphi_velocity_sums(k, dim, cloud, cloud.volume, v, i, &moment);
        int state = sph_solve_gradient(dim, moment, &inverse, 0);
        if (state)
            state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, sphi_at(cloud.h, i), dim);
        g.x = sphi_sym_times(dim, inverse, g.x); /* 0, if there is no inverse */
        g.y = sphi_sym_times(dim, inverse, g.y);
        g.z = sphi_sym_times(dim, inverse, g.z);
        if (sphi_store_gradient(dim, out, i, g)) state = SPH_NOT_FINITE;
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* Where the indicator of shocks goes. Each pointer may be null. */
typedef struct sph_shock_out {
    SPH_GLOBAL sph_real *ratio, *v_sig; /* R, and the signal speed of the switch */
    size_t stride;                      /* of these two, in sph_real; 0 counts as 1 */
    SPH_GLOBAL unsigned char *status;
} sph_shock_out;
/* What Cullen & Dehnen's switch needs of the neighbours: R_i = (1 / rho_i) sum_j sign(div v_j) m_j W_ij(h_i),
   with the particle itself, and v_sig = max over j of (c_i + c_j) / 2 + max(-w, 0), which is not below c_i.
   Of state, medium, cs and v are read; div_v is that of all sources. Cullen & Dehnen 2010. */
SPH_FN sph_index sph_shock_indicator(sph_kernel k, int dim, sph_cloud cloud, sph_gas state, sph_scalars div_v,
                                     sph_shock_out out)
{
    const size_t stride = sphi_stride(out.stride);
    sph_real support, v_sig[SPHI_TILE];
    int error = sphi_check_medium(k, dim, cloud, state.medium, cloud.last);
    sph_index i, p, tile, end, failed = 0;
    if (!error) error = sphi_check_not_negative("cs", state.cs, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, state.v, cloud.points.n);
    if (!error) error = sphi_check_field("div_v", div_v, cloud.points.n);
    if (error) return sphi_answer_of(error);
    support = sph_kernel_support_ratio(k);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, state.v, i);
        const sph_real h_i = sphi_at(cloud.h, i), c_i = sphi_at(state.cs, i);
        sph_real speed = c_i, sum = sph_shock_pair(sphi_at(state.medium.m, i), sphi_at(div_v, i),
                                                   sph_kernel_w(k, dim, SPH_R(0), h_i));
        int lost;
        for (tile = cloud.list.start[i]; tile < cloud.list.start[i + 1]; tile = end) {
            end = cloud.list.start[i + 1] - tile < SPHI_TILE ? cloud.list.start[i + 1] : tile + SPHI_TILE;
            SPH_SUM(p, tile, end, sum) {
                const sph_index j = cloud.list.index[p];
                const sph_vec x_ij =
                    sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
                const sph_real r = sph_length(dim, x_ij),
                               w = sph_dot(dim, sph_subtract(dim, v_i, sphi_vector_at(dim, state.v, j)),
                                           x_ij) /
                                   (r + SPHI_TINY);
                sum += sph_shock_pair(sphi_at(state.medium.m, j), sphi_at(div_v, j),
                                      sph_kernel_w(k, dim, r, h_i));
                v_sig[p - tile] = sph_signal_speed(c_i, sphi_at(state.cs, j), SPHI_ABS(w) - w) *
                                  sphi_within(support, h_i, sphi_at(cloud.h, j), r);
            }
            speed = sphi_largest(speed, v_sig, (int)(end - tile));
        }
        lost = sphi_put(out.ratio, stride, i, sph_shock_value(sum, sphi_at(state.medium.rho, i)));
        lost |= sphi_put(out.v_sig, stride, i, speed);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}

/* ================================================================ magnetohydrodynamics and cleaning
 *
 * The order of a step: density, h and Omega from positions (sph_density_adaptive), then pressure and sound
 * speed from density and u, then sph_mhd_rates. All rates belong to one instant: v, u, B and psi must be
 * those of the positions. Stages of Runge-Kutta's kind have them. In kick-drift-kick, where v is half a step
 * behind x, predict them from their last rates: otherwise du/dt does not balance the work of the forces, and
 * the energy has an error of first order in dt (tests/test_cleaning.c: 1.6e-3 instead of 6e-6).
 *
 * Units with mu_0 = 1: divide a field B of other units by sqrt(mu_0). g_i, g_j and G are those of the chapter
 * on gas. Without a field sph_mhd_rates is sph_gas_rates, at twice its cost.
 *
 * Sources: Tricco & Price 2012, 7th SPHERIC workshop (equation numbers without a name are those of this
 * paper); Tricco & Price 2012, JCP 231, 7214. Price 2012, JCP 231, 759, for the whole of SPMHD.
 *
 * Conjugate operators: the difference form of div and the symmetric form of grad are adjoint,
 *     sum V psi (div B) = -sum V B . (grad psi)   with V = m / rho,
 * for any B and psi, also with an h of each particle. The energy that the cleaning wave takes from the
 * magnetic field is therefore exactly what the energy of psi, sum m psi^2 / (2 rho ch^2), receives, and
 * vice versa: (2), (12), (23). Damping only takes energy away. The pair of two difference forms has no
 * such balance: at edges and density jumps the energy grows without bounds (tests/test_cleaning.c;
 * examples/papers/cleaning_forms.h has that pair for comparison).
 *
 * Misprints that are corrected here:
 *   - (6) has grad_b in its second term, where grad_a is right.
 *   - (8) has + B^2/2, where -(P + B^2/2) is right.
 *   - (10) needs the square of the mean density.
 *   - (28) needs a plus sign, (38) a minus sign.
 */

/* -------- magnetohydrodynamics and cleaning: stress, speeds, cleaning waves, switches */

/* M . x_ij of the stress M = B B - (P + B^2/2) 1 (Maxwell stress and pressure), with Bx = B .
   x_ij. The acceleration of i by j is m_j (M_i . x_ij g_i + M_j . x_ij g_j), (6). All three
   components of field are read. */
SPH_FN sph_vec sph_mhd_traction(sph_vec field, sph_real pressure, sph_real Bx, sph_vec x_ij)
{
    const sph_real p = pressure + SPH_R(0.5) * sph_dot(3, field, field);
    sph_vec t;
    t.x = field.x * Bx - p * x_ij.x;
    t.y = field.y * Bx - p * x_ij.y;
    t.z = field.z * Bx - p * x_ij.z;
    return t;
}
/* The fast speed from the squares of the sound speed, of the Alfven speed, and of its part along the pair. */
SPH_FN sph_real sphi_fast_speed(sph_real sound2, sph_real alfven2, sph_real along2)
{
    const sph_real s = sound2 + alfven2, d = s * s - SPH_R(4) * sound2 * along2;
    return SPHI_SQRT(SPH_R(0.5) * (s + SPHI_SQRT(SPH_R(0.5) * (d + SPHI_ABS(d)))));
}
/* The fast magnetosonic speed v along the pair, with vA^2 = B^2 / rho and B_along = B . x_ij / r:
       v^2 = (cs^2 + vA^2 + sqrt((cs^2 + vA^2)^2 - 4 cs^2 B_along^2 / rho)) / 2.
   All three components of field are read. With B_along = 0 it is the largest speed, that across the field.
   Needs rho > 0, and |B_along| not above |B| but for rounding. */
SPH_FN sph_real sph_mhd_fast_speed(sph_real cs, sph_vec field, sph_real rho, sph_real B_along)
{
    const sph_real per_rho = SPH_R(1) / rho;
    SPH_ASSERT(rho > SPH_R(0) &&
               B_along * B_along <= (SPH_R(1) + SPH_R(64) * SPH_EPSILON) * sph_dot(3, field, field));
    return sphi_fast_speed(cs * cs, sph_dot(3, field, field) * per_rho, B_along * B_along * per_rho);
}

/* The cleaning wave at a particle: its speed ch, its damping sigma (a pure number), and the
   smoothing length. */
typedef struct sph_cleaning_wave {
    sph_real ch, sigma, h;
    SPHI_TCC_PAD
} sph_cleaning_wave;
#define SPHI_IS_WAVE(w) ((w).ch >= SPH_R(0) && (w).sigma >= SPH_R(0) && (w).h > SPH_R(0))

/* dpsi/dt = -ch^2 div B - sigma ch psi / h - psi div v / 2: (2) and (25), with 1/tau = sigma ch / h, (19).
   psi has the unit of B times a velocity. sigma: 0.2 to 0.3 in 2D, 0.8 to 1.2 in 3D (Tricco & Price 2012);
   see sph_cleaning_sigma. This and the other two rates need ch >= 0 and sigma >= 0. */
SPH_FN sph_real sph_cleaning_rate(sph_cleaning_wave w, sph_real psi, sph_real div_B, sph_real div_v)
{
    SPH_ASSERT(SPHI_IS_WAVE(w));
    return -w.ch * w.ch * div_B - (w.sigma * w.ch / w.h + SPH_R(0.5) * div_v) * psi;
}
/* The same for psi_over_ch = psi / ch: d(psi/ch)/dt = -ch div B - sigma ch (psi/ch) / h - (psi/ch) div v / 2.
   For a ch that changes with time; the energy sum m (psi/ch)^2 / (2 rho) then does not change with ch.
   Tricco, Price & Bate 2016, JCP 322, 326. Where grad psi is needed, take psi = ch (psi/ch). */
SPH_FN sph_real sph_cleaning_rate_scaled(sph_cleaning_wave w, sph_real psi_over_ch, sph_real div_B,
                                         sph_real div_v)
{
    SPH_ASSERT(SPHI_IS_WAVE(w));
    return -w.ch * div_B - (w.sigma * w.ch / w.h + SPH_R(0.5) * div_v) * psi_over_ch;
}
/* A usual damping sigma of cleaning waves: 0.3 in 1D and 2D, 1 in 3D. */
SPH_FN sph_real sph_cleaning_sigma(int dim)
{
    SPH_ASSERT(SPHI_IS_DIM(dim));
    return dim < 3 ? SPH_R(0.3) : SPH_R(1);
}
/* Velocity cleaning, (29)-(39), in which psi is a pressure. The acceleration is that of
   sph_fluid_rates_monaghan with p + psi in the place of p. Its density_rate drho/dt, (28), then gives
       dpsi/dt = ch^2 drho/dt - sigma ch psi / h.
   It conserves linear and angular momentum and, without damping and with a fixed rho, the energy sum m
   (v^2/2 + psi^2 / (2 ch^2 rho^2)). The Courant limit takes the speed sqrt(cs^2 + ch^2). */
SPH_FN sph_real sph_cleaning_rate_velocity(sph_cleaning_wave w, sph_real psi, sph_real density_rate)
{
    SPH_ASSERT(SPHI_IS_WAVE(w));
    return w.ch * w.ch * density_rate - w.sigma * w.ch / w.h * psi;
}

/* B = grad_alpha x grad_beta, with the gradients of the Euler potentials alpha and beta. In 2D alpha = A_z
   and beta = z: B = (dA_z/dy, -dA_z/dx). With gradients by sph_gradient_cspm it is exact for linear
   potentials. div B is 0 in the continuum. The potentials move with the particles, without change: Rosswog &
   Price 2007, MNRAS 379, 915; Price 2012, JCP 231, 759.
   What they cannot represent: with A = alpha grad beta we have A . B = 0. A field whose lines are linked
   or knotted, so that its helicity (the integral of A . B) is not 0, therefore has no single-valued
   potentials. Potentials that do not change along the motion also exclude resistivity and reconnection.
   And motion that winds a field up brings particles together whose potentials differ more and more, until
   their gradients are no longer resolved: with n layers of particles half of the field is lost after about
   0.075 n windings (examples/papers/cleaning_euler_potentials.c). */
SPH_FN sph_vec sph_euler_potentials(sph_vec grad_alpha, sph_vec grad_beta)
{
    return sphi_cross(grad_alpha, grad_beta);
}
/* alpha_B / alpha_max = min(1, h change / B), which lets resistivity act only where the field changes
   within h. strength: B = |B|. change: |grad B|, the root of the sum of the squares of all its components
   (Tricco & Price 2013, MNRAS 436, 2810, with alpha_max = 1), or |curl B|, which leaves the divergence to
   the cleaning. It is 0 where nothing changes, and 1 where B = 0 but change is not. Needs change >= 0 and
   strength >= 0. */
SPH_FN sph_real sph_resistivity_switch(sph_real h, sph_real change, sph_real strength)
{
    SPH_ASSERT(h > SPH_R(0) && change >= SPH_R(0) && strength >= SPH_R(0));
    return strength > h * change ? h * change / strength : change > SPH_R(0) ? SPH_R(1) : SPH_R(0);
}

/* -------- magnetohydrodynamics and cleaning: gradient, divergence, curl; pair functions */

/* What j adds to the difference form of the divergence: weight a_ij . x_ij with weight = m_j F_i and
   a_ij = A_i - A_j. Of the sum, div A_i = sph_medium_difference(i, sum), (20). Exact for constants. */
SPH_FN sph_real sph_divergence_pair_difference(int dim, sph_real weight, sph_vec a_ij, sph_vec x_ij)
{
    return weight * sph_dot(dim, a_ij, x_ij);
}
/* What j adds to the difference form of the curl: weight a_ij x x_ij (a cross product) with
   weight = m_j F_i and a_ij = A_i - A_j. Of the sum, curl A_i = -sph_medium_difference(i, component) for
   each component: note the sign. Price 2012, (79). Exact for constants. */
SPH_FN sph_vec sph_curl_pair_difference(sph_real weight, sph_vec a_ij, sph_vec x_ij)
{
    return sphi_cross(sph_scale(weight, a_ij), x_ij);
}
/* What j adds to the symmetric form of the divergence: a_i . x_ij m_j g_i + a_j . x_ij m_j g_j. div a_i is
   rho_i times the sum. It is what (9) subtracts. Not 0 for constants. This form and the difference form of
   the gradient are conjugate. */
SPH_FN sph_real sph_divergence_pair_symmetric(int dim, sph_pair_weights w, sph_vec a_i, sph_vec a_j,
                                              sph_vec x_ij)
{
    return sph_dot(dim, a_i, x_ij) * w.i + sph_dot(dim, a_j, x_ij) * w.j;
}
/* What j adds to the symmetric form of the gradient: (f_i m_j g_i + f_j m_j g_j) x_ij, (23).
   grad f_i is rho_i times the sum. Not 0 for constants. This form and the difference form of the
   divergence are conjugate. */
SPH_FN sph_vec sph_gradient_pair_symmetric(sph_pair_weights w, sph_real f_i, sph_real f_j, sph_vec x_ij)
{
    return sph_scale(f_i * w.i + f_j * w.j, x_ij);
}

/* -------- magnetohydrodynamics and cleaning: magnetised gas; pair functions */

/* Stretching of the field, (7): weight (B_i . x_ij) v_ij with weight = m_j F_i and Bx_i = B_i . x_ij. With
   div v in difference form,
       dB_i/dt = sph_medium_difference(i, each component of the sum) - B_i div v_i. */
SPH_FN sph_vec sph_induction_pair(sph_real weight, sph_real Bx_i, sph_vec v_ij)
{
    return sph_scale(weight * Bx_i, v_ij);
}
/* Artificial resistivity, (10), for shocks (sph_resistivity_pair_ohmic is the physical one): weight
   alpha_speed per_rho^2 <= 0, the coefficient b of B_ij in dB_i/dt = rho_i sum_j b B_ij. Here weight = m_j G
   r, alpha_speed = alpha_B v_sig, and per_rho is 1 over the mean density. (Its square is what (10) lacks.) */
SPH_FN sph_real sph_resistivity_pair(sph_real weight, sph_real alpha_speed, sph_real per_rho)
{
    return weight * alpha_speed * per_rho * per_rho;
}

/* The resistivities of the two particles of a pair. */
typedef struct sph_ohmic_pair {
    sph_real i, j;
} sph_ohmic_pair;
/* Physical (Ohmic) resistivity, (11): the coefficient b <= 0 of B_ij in dB_i/dt = rho_i sum_j b B_ij,
       b = 2 eta m_j G / (rho_i rho_j),
   eta being the harmonic mean of the two particles, in length^2 / time. It is Brookshaw's form of eta (grad
   div B - curl curl B) = eta lap B, component by component, and exact for constant B.
   Where eta varies it is div(eta grad B), with a flux that is continuous where eta jumps; -curl(eta curl B)
   has terms with grad eta beside it. weight = m_j G. Of m, rho and omega of the sides, rho is read. The
   artificial one that catches shocks is sph_resistivity_pair. Needs rho > 0 and eta >= 0 on both sides. */
SPH_FN sph_real sph_resistivity_pair_ohmic(sph_medium_side i, sph_medium_side j, sph_ohmic_pair eta,
                                           sph_real weight)
{
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0) && eta.i >= SPH_R(0) && eta.j >= SPH_R(0));
    return weight * sph_mobility_pair((int)SPH_MOBILITY_HARMONIC, eta.i, eta.j, SPH_R(0)) / (i.rho * j.rho);
}
/* The heat of either resistivity, what j adds to du_i/dt: -b B_ij^2 / 2 >= 0, b being that of the pair. With
   it sum m (u + B^2 / (2 rho)) is conserved at fixed rho. All three components of B_ij are read. */
SPH_FN sph_real sph_resistivity_heat(sph_real b, sph_vec B_ij)
{
    return SPH_R(-0.5) * b * sph_dot(3, B_ij, B_ij);
}
/* The longest explicit step by resistivity, 0.125 h^2 / eta: that of sph_time_step_viscous_nu. Needs
   eta >= 0. */
SPH_FN sph_real sph_time_step_resistivity(sph_real h, sph_real eta)
{
    return sph_time_step_viscous_nu(h, eta);
}

/* The values of one particle. Components of v and field beyond sph_mhd_terms.parts must be 0. */
typedef struct sph_mhd_side {
    sph_medium_side medium;
    /* pressure, thermal energy per mass, sound speed, coefficients of viscosity and resistivity, cleaning
       field. Without cleaning psi must be 0: sph_mhd_pair does not read it then, but sph_mhd_value does. */
    sph_real p, u, cs, alpha, alpha_B, psi;
    sph_vec v, field; /* velocity and B */
} sph_mhd_side;
/* What is the same for all pairs. */
typedef struct sph_mhd_terms {
    sph_real beta, alpha_u; /* of the signal speed, and of conductivity; pure numbers, usually 2 and 1 */
    /* parts: 3 where v and field have three components, else the dimension. cleans: 1 if there is a psi. */
    int parts, cleans;
} sph_mhd_terms;
/* What j adds to the sums of particle i, or these sums. sph_mhd_value makes rates of them. */
typedef struct sph_mhd_sums {
    /* force: the acceleration by (6) and viscosity, without (9). stretching: of sph_induction_pair. cleaning:
       (grad psi) / rho_i. resistivity: dB/dt by (10) over rho_i. */
    sph_vec force, stretching, cleaning, resistivity;
    /* tension: (div B) / rho_i in symmetric form. div_v, div_B: sums of the difference form, before
       sph_medium_difference. heat: du/dt by viscosity, conductivity and resistivity. */
    sph_real tension, div_v, div_B, heat;
    sph_real speed; /* the signal speed of the pair; of the sums, the largest. Not read by sph_mhd_value */
} sph_mhd_sums;

/* The whole interaction of a pair: what j adds to i by (6), (7), (10), (23), artificial viscosity and
   conductivity. See sph_mhd_rates. Needs rho > 0 and Omega > 0 on both sides, and dim <= parts <= 3. */
SPH_FN sph_mhd_sums sph_mhd_pair(int dim, sph_mhd_terms terms, sph_mhd_side i, sph_mhd_side j,
                                 sph_pair_kernel f, sph_vec x_ij)
{
    const sphi_meeting e = sphi_meet(i.medium, j.medium, f);
    const sph_vec v_ij = sph_subtract(terms.parts, i.v, j.v),
                  B_ij = sph_subtract(terms.parts, i.field, j.field);
    const sph_real Bx_i = sph_dot(dim, i.field, x_ij), Bx_j = sph_dot(dim, j.field, x_ij),
                   vx = sph_dot(dim, v_ij, x_ij), w = vx * e.per_r, along_i = Bx_i * e.per_r,
                   along_j = Bx_j * e.per_r;
    const sph_real speed =
        sph_signal_speed(sphi_fast_speed(i.cs * i.cs, sph_dot(3, i.field, i.field) * e.per_rho_i,
                                         along_i * along_i * e.per_rho_i),
                         sphi_fast_speed(j.cs * j.cs, sph_dot(3, j.field, j.field) * e.per_rho_j,
                                         along_j * along_j * e.per_rho_j),
                         terms.beta * SPHI_ABS(w));
    const sph_real resistivity =
        sph_resistivity_pair(e.mean_f * f.r, SPH_R(0.5) * (i.alpha_B + j.alpha_B) * speed, e.per_rho);
    const sphi_dissipation lost = sphi_dissipate(
        e, f.r, w, SPH_R(0.5) * (i.alpha + j.alpha) * speed,
        sphi_conduction((int)SPH_CONDUCTIVITY_PRICE, terms.alpha_u, i.p, j.p, i.u - j.u, w, e.per_rho));
    const sph_vec t_i = sph_mhd_traction(i.field, i.p, Bx_i, x_ij),
                  t_j = sph_mhd_traction(j.field, j.p, Bx_j, x_ij);
    sph_mhd_sums c;
    SPH_ASSERT(SPHI_IS_DIM(dim) && dim <= terms.parts && terms.parts <= 3 && f.r >= SPH_R(0) &&
               i.medium.rho > SPH_R(0) && i.medium.omega > SPH_R(0) && j.medium.rho > SPH_R(0) &&
               j.medium.omega > SPH_R(0));
    c.force.x = t_i.x * e.g.i + t_j.x * e.g.j - lost.push * x_ij.x;
    c.force.y = t_i.y * e.g.i + t_j.y * e.g.j - lost.push * x_ij.y;
    c.force.z = t_i.z * e.g.i + t_j.z * e.g.j - lost.push * x_ij.z;
    c.stretching = sph_induction_pair(e.weight, Bx_i, v_ij);
    c.cleaning = sph_gradient_pair_symmetric(e.g, terms.cleans ? i.psi : SPH_R(0),
                                             terms.cleans ? j.psi : SPH_R(0), x_ij);
    c.resistivity = sph_scale(resistivity, B_ij);
    c.tension = Bx_i * e.g.i + Bx_j * e.g.j;
    c.div_v = e.weight * vx;
    c.div_B = e.weight * (Bx_i - Bx_j);
    c.heat = lost.heat + sph_resistivity_heat(resistivity, B_ij);
    c.speed = speed;
    return c;
}

/* The rates of a particle: dv/dt, dB/dt, du/dt and dpsi/dt, and div B and div v in difference form. */
typedef struct sph_mhd_change {
    sph_vec acceleration, rate_B;
    sph_real rate_u, rate_psi, div_B, div_v;
} sph_mhd_change;
/* The rates of particle i from its sums. tensile: see sph_mhd. wave: with the h of the particle; ch = 0
   without cleaning. Needs rho > 0 and Omega > 0, and what sph_cleaning_rate needs. */
SPH_FN sph_mhd_change sph_mhd_value(sph_mhd_side i, sph_mhd_sums s, sph_real tensile, sph_cleaning_wave wave)
{
    const sph_real per = SPH_R(1) / (i.medium.omega * i.medium.rho), rho = i.medium.rho;
    sph_mhd_change c;
    c.div_v = -s.div_v * per;
    c.div_B = -s.div_B * per;
    c.acceleration = sph_subtract(3, s.force, sph_scale(tensile * s.tension, i.field));
    c.rate_B.x = rho * (s.resistivity.x - s.cleaning.x) - s.stretching.x * per - i.field.x * c.div_v;
    c.rate_B.y = rho * (s.resistivity.y - s.cleaning.y) - s.stretching.y * per - i.field.y * c.div_v;
    c.rate_B.z = rho * (s.resistivity.z - s.cleaning.z) - s.stretching.z * per - i.field.z * c.div_v;
    c.rate_u = i.p * sph_medium_weight(i.medium) * s.div_v + s.heat;
    c.rate_psi = sph_cleaning_rate(wave, i.psi, c.div_B, c.div_v);
    return c;
}

/* -------- magnetohydrodynamics and cleaning: sweeps
   Lists must hold all pairs with r < support ratio * max(h_i, h_j) (SPH_LARGER). rho and Omega come from
   sph_density_adaptive; with a constant h take any density, and sph_scalars_same(&one) for Omega. In two
   dimensions vectors may have a third component: it is there if its array is there. Sweeps return the
   number of targets of which a result overflowed (it is 0 then), or a negative sph_error. */

SPH_FN sph_cleaning_wave sphi_cleaning_wave(sph_real ch, sph_real sigma, sph_real h)
{
    sph_cleaning_wave w;
    w.ch = ch;
    w.sigma = sigma;
    w.h = h;
    return w;
}
/* 3 where a vector has three arrays, else dim. */
SPH_FN int sphi_components(int dim, sph_vectors v) { return v.z.p ? 3 : dim; }

/* div A_i = -(1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) . grad_i W_ij(h_i), the difference form (20).
   Exact for constants. For A = v it is -(drho/dt) / rho.
   Atlas: divergence exact for constants; order 0 inside lattices, 0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_divergence_difference(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                           sph_vectors field, sph_scalar_out out)
{
    int error = sphi_check_medium(k, dim, cloud, medium, cloud.last);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("field", dim, field, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), A_i = sphi_vector_at(dim, field, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real sum = SPH_R(0);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_vec A_ij = sph_subtract(dim, A_i, sphi_vector_at(dim, field, j));
            const sph_real f_i = sph_kernel_f(k, dim, sph_length(dim, x_ij), h_i);
            sum += sph_divergence_pair_difference(dim, sphi_at(medium.m, j) * f_i, A_ij, x_ij);
        }
        failed += sphi_store(out, i, sph_medium_difference(sphi_medium_side(&medium, i), sum));
    }
    return failed;
}
/* div A_i = rho_i sum_j m_j (A_i g_i + A_j g_j) . x_ij, the symmetric form, which (9) subtracts. It also
   measures the disorder of the particles, and is not 0 for constant A.
   Atlas: divergence exact for nothing, inside lattices for constants; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_divergence_symmetric(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                          sph_vectors field, sph_scalar_out out)
{
    int error = sphi_check_medium(k, dim, cloud, medium, cloud.points.n);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("field", dim, field, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), A_i = sphi_vector_at(dim, field, i);
        const sph_real h_i = sphi_at(cloud.h, i), own = sph_medium_weight(sphi_medium_side(&medium, i));
        sph_real sum = SPH_R(0);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_medium_side other = sphi_medium_side(&medium, j);
            const sph_pair_weights w = sph_pair_weights_of(
                other.m, sphi_pair_kernel(k, dim, 0, x_ij, h_i, cloud.h, j), own, sph_medium_weight(other));
            sum += sph_divergence_pair_symmetric(dim, w, A_i, sphi_vector_at(dim, field, j), x_ij);
        }
        failed += sphi_store(out, i, sphi_at(medium.rho, i) * sum);
    }
    return failed;
}
/* grad f_i = rho_i sum_j m_j (f_i g_i + f_j g_j) x_ij, the symmetric form (23). It is the conjugate of the
   difference form of the divergence, and not 0 for constant f.
   Atlas: gradient exact for nothing, inside lattices for constants; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_gradient_symmetric(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                        sph_scalars f, sph_vector_out out)
{
    int error = sphi_check_medium(k, dim, cloud, medium, cloud.points.n);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error) error = sphi_check_out("out", dim, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), own = sph_medium_weight(sphi_medium_side(&medium, i)),
                       f_i = sphi_at(f, i), rho_i = sphi_at(medium.rho, i);
        sph_real sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sx, sy, sz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_medium_side other = sphi_medium_side(&medium, j);
            const sph_pair_weights w = sph_pair_weights_of(
                other.m, sphi_pair_kernel(k, dim, 0, x_ij, h_i, cloud.h, j), own, sph_medium_weight(other));
            const sph_vec c = sph_gradient_pair_symmetric(w, f_i, sphi_at(f, j), x_ij);
            sx += c.x;
            if (dim > 1) sy += c.y;
            if (dim > 2) sz += c.z;
        }
        sum.x = rho_i * sx;
        sum.y = rho_i * sy;
        sum.z = rho_i * sz;
        failed += sphi_store_vector(dim, out, i, sum);
    }
    return failed;
}
/* curl A_i = (1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) x grad_i W_ij(h_i), the difference form. Exact
   for constants. Price 2012, (79). The result has three components, of which only the third is not 0 in 2D
   if A has two components; `out` must have three arrays.
   Atlas: curl exact for constants; order 0 inside lattices, 0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_curl_difference(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                     sph_vectors field, sph_vector_out out)
{
    const int parts = sphi_components(dim, field);
    int error = sphi_check_medium(k, dim, cloud, medium, cloud.last);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("field", parts, field, cloud.points.n);
    if (!error) error = sphi_check_out("out", 3, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), A_i = sphi_vector_at(parts, field, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_medium_side own = sphi_medium_side(&medium, i);
        sph_real cx = SPH_R(0), cy = SPH_R(0), cz = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], cx, cy, cz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_vec A_ij = sph_subtract(3, A_i, sphi_vector_at(parts, field, j));
            const sph_real f_i = sph_kernel_f(k, dim, sph_length(dim, x_ij), h_i);
            const sph_vec c = sph_curl_pair_difference(sphi_at(medium.m, j) * f_i, A_ij, x_ij);
            cx += c.x;
            cy += c.y;
            cz += c.z;
        }
        sum.x = -sph_medium_difference(own, cx);
        sum.y = -sph_medium_difference(own, cy);
        sum.z = -sph_medium_difference(own, cz);
        failed += sphi_store_vector(3, out, i, sum);
    }
    return failed;
}

/* The state of divergence cleaning, one number or vector for each particle, all sources. */
typedef struct sph_cleaning {
    sph_medium medium;
    sph_vectors field;      /* B, of dim components */
    sph_scalars psi, div_v; /* div_v: of the targets; sph_scalars_none(): div v = 0 */
    sph_real ch, sigma;     /* speed and damping of the cleaning waves; see sph_cleaning_sigma */
} sph_cleaning;
/* Where the rates of cleaning go. */
typedef struct sph_cleaning_out {
    sph_vector_out rate_B;
    SPH_GLOBAL sph_real *rate_psi, *div_B; /* div_B may be null */
    size_t stride;                         /* of these two */
    SPH_GLOBAL unsigned char *status;      /* may be null */
} sph_cleaning_out;
/* Divergence cleaning alone, for a host that has the rest of its MHD:
       dB/dt   = -grad psi   in symmetric form, (23),
       dpsi/dt = -ch^2 div B - sigma ch psi / h - psi div v / 2   with div B in difference form, (20), (25).
   ch is one speed for all particles: the largest fast speed of the cloud (times a factor of over-cleaning,
   if the time step is divided by this factor). sigma is usually sph_cleaning_sigma(dim).
   Cleaning conserves sum m (B^2 + psi^2/ch^2) / (2 rho) for any h and Omega, except for the damping, which
   only takes energy away. Where rho changes, the term with div v is needed for this. It also conserves sum
   m B / rho, to round-off.
   Atlas: gradient exact for nothing, inside lattices for constants; order 0 inside lattices, -1 in
   disorder, -1 at boundaries.
   Atlas: divergence exact for constants; order 0 inside lattices, 0 in disorder, 0 at boundaries. */
SPH_FN sph_index sph_cleaning_rates(sph_kernel k, int dim, sph_cloud cloud, sph_cleaning state,
                                    sph_cleaning_out out)
{
    const sph_medium medium = state.medium;
    const sph_vectors field = state.field;
    const sph_scalars psi = state.psi, div_v = state.div_v;
    const sph_real ch = state.ch, sigma = state.sigma;
    const size_t stride = sphi_stride(out.stride);
    int error = sphi_check_medium(k, dim, cloud, medium, cloud.points.n);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("field", dim, field, cloud.points.n);
    if (!error) error = sphi_check_field("psi", psi, cloud.points.n);
    if (!error && div_v.p) error = sphi_check_field("div_v", div_v, cloud.last);
    if (!error) error = sphi_check_out("rate_B", dim, out.rate_B);
    if (!error && !out.rate_psi) error = sphi_refuse("out.rate_psi", -1, SPH_ERROR_NULL);
    if (!error && (!sphi_finite(ch) || ch < SPH_R(0) || !sphi_finite(sigma) || sigma < SPH_R(0)))
        error = sphi_refuse("ch, sigma", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), B_i = sphi_vector_at(dim, field, i);
        const sph_real h_i = sphi_at(cloud.h, i), rho_i = sphi_at(medium.rho, i),
                       own = sph_medium_weight(sphi_medium_side(&medium, i)), psi_i = sphi_at(psi, i);
        sph_real sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0), divergence = SPH_R(0);
        sph_vec sum;
        int lost;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sx, sy, sz, divergence) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_medium_side other = sphi_medium_side(&medium, j);
            const sph_pair_weights w = sph_pair_weights_of(
                other.m, sphi_pair_kernel(k, dim, 0, x_ij, h_i, cloud.h, j), own, sph_medium_weight(other));
            const sph_vec B_ji = sph_subtract(dim, sphi_vector_at(dim, field, j), B_i);
            const sph_vec c = sph_gradient_pair_symmetric(w, psi_i, sphi_at(psi, j), x_ij);
            divergence += sph_divergence_pair_difference(dim, w.i, B_ji, x_ij);
            sx -= c.x;
            if (dim > 1) sy -= c.y;
            if (dim > 2) sz -= c.z;
        }
        sum.x = rho_i * sx;
        sum.y = rho_i * sy;
        sum.z = rho_i * sz;
        divergence *= rho_i; /* w.i contains g_i, which is F_i / (Omega rho) divided by rho */
        lost = sphi_store_vector(dim, out.rate_B, i, sum);
        lost |= sphi_put(out.rate_psi, stride, i,
                         sph_cleaning_rate(sphi_cleaning_wave(ch, sigma, h_i), psi_i, divergence,
                                           div_v.p ? sphi_at(div_v, i) : SPH_R(0)));
        lost |= sphi_put(out.div_B, stride, i, divergence);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}

/* The state of a resistive medium, one number or vector for each particle, all sources. */
typedef struct sph_ohmic {
    sph_medium medium;
    sph_scalars eta;   /* resistivity >= 0 in length^2 / time, with mu_0 = 1: 1 / conductivity */
    sph_vectors field; /* B: three components if field.z has an array, else dim */
} sph_ohmic;
/* Where its rates go. rate_u and status may be null. */
typedef struct sph_ohmic_out {
    sph_vector_out rate_B;
    SPH_GLOBAL sph_real *rate_u;
    size_t stride; /* of rate_u, in sph_real; 0 counts as 1 */
    SPH_GLOBAL unsigned char *status;
} sph_ohmic_out;
SPH_FN sph_index sphi_ohmic_range(int parts, sph_kernel k, int dim, sph_cloud cloud, const sph_ohmic *s,
                                  const sph_ohmic_out *out)
{
    const sph_ohmic state = *s;
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), B_i = sphi_vector_at(parts, state.field, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_medium_side own = sphi_medium_side(&state.medium, i);
        sph_real bx = SPH_R(0), by = SPH_R(0), bz = SPH_R(0), heat = SPH_R(0);
        sph_ohmic_pair eta;
        sph_vec sum;
        int lost;
        eta.i = sphi_at(state.eta, i);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], bx, by, bz, heat) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          B_ij = sph_subtract(3, B_i, sphi_vector_at(parts, state.field, j));
            const sph_medium_side other = sphi_medium_side(&state.medium, j);
            const sphi_meeting e = sphi_meet(own, other, sphi_pair_kernel(k, dim, 0, x_ij, h_i, cloud.h, j));
            sph_ohmic_pair both = eta;
            sph_real b;
            both.j = sphi_at(state.eta, j);
            b = sph_resistivity_pair_ohmic(own, other, both, e.mean_f);
            bx += b * B_ij.x;
            by += b * B_ij.y;
            bz += b * B_ij.z;
            heat += sph_resistivity_heat(b, B_ij);
        }
        sum.x = own.rho * bx;
        sum.y = own.rho * by;
        sum.z = own.rho * bz;
        lost = sphi_store_vector(parts, out->rate_B, i, sum);
        lost |= sphi_put(out->rate_u, sphi_stride(out->stride), i, heat);
        sphi_tell(out->status, i, lost);
        failed += lost;
    }
    return failed;
}
/* dB/dt and du/dt by physical resistivity, (11): the sums of sph_resistivity_pair_ohmic and its heat, to be
   added to those of sph_mhd_rates, whose resistivity is artificial. For constant eta it is eta lap B. Heat is
   never negative; sum m B / rho, and sum m (u + B^2 / (2 rho)) with it, do not change, to round-off, for any
   h and Omega. Explicit steps are limited by sph_time_step_resistivity.
   Atlas: Laplacian exact for constants, inside lattices for linear fields; order 0 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_resistivity_ohmic(sph_kernel k, int dim, sph_cloud cloud, sph_ohmic state,
                                       sph_ohmic_out out)
{
    const int parts = sphi_components(dim, state.field);
    int error = sphi_check_medium(k, dim, cloud, state.medium, cloud.points.n);
    if (!error) error = sphi_check_not_negative("eta", state.eta, cloud.points.n);
    if (!error) error = sphi_check_vectors("field", parts, state.field, cloud.points.n);
    if (!error) error = sphi_check_out("rate_B", parts, out.rate_B);
    if (error) return sphi_answer_of(error);
    return parts == dim ? sphi_ohmic_range(dim, k, dim, cloud, &state, &out)
                        : sphi_ohmic_range(3, k, dim, cloud, &state, &out);
}

/* The state of a magnetised gas, one number or vector for each particle, all sources. */
typedef struct sph_mhd {
    sph_medium medium;
    sph_scalars p, u, cs; /* pressure, thermal energy per mass, sound speed */
    /* Coefficients of viscosity and resistivity of each particle, 0 (none) to 1. A pair takes the mean. */
    sph_scalars alpha, alpha_B;
    sph_vectors v, field;   /* velocity and B: three components each if v.z has an array, else dim */
    sph_scalars psi;        /* sph_scalars_none(): no cleaning */
    sph_real ch, sigma;     /* speed and damping of the cleaning waves; see sph_cleaning_rates */
    sph_real beta, alpha_u; /* of signal speed and conductivity; 2 and 1 are usual; alpha_u = 0: none */
    /* The part of (9) that is subtracted. 1: all of it. 0: none; momentum is then conserved, but particles
       attract each other and form pairs where B^2/2 > P. */
    sph_real tensile;
} sph_mhd;
/* Where rates go. acceleration and rate_B must be there; the other pointers may be null. */
typedef struct sph_mhd_out {
    sph_vector_out acceleration, rate_B;
    /* du/dt, dpsi/dt, div B and div v in difference form, and the largest signal speed */
    SPH_GLOBAL sph_real *rate_u, *rate_psi, *div_B, *div_v, *v_sig;
    size_t stride; /* of these five, in sph_real; 0 counts as 1 */
    SPH_GLOBAL unsigned char *status;
} sph_mhd_out;

SPH_FN sph_mhd_side sphi_mhd_side(int parts, int cleans, const sph_mhd *s, sph_index i)
{
    sph_mhd_side a;
    a.medium = sphi_medium_side(&s->medium, i);
    a.p = sphi_at(s->p, i);
    a.u = sphi_at(s->u, i);
    a.cs = sphi_at(s->cs, i);
    a.alpha = sphi_at(s->alpha, i);
    a.alpha_B = sphi_at(s->alpha_B, i);
    a.psi = cleans ? sphi_at(s->psi, i) : SPH_R(0);
    a.v = sphi_vector_at(parts, s->v, i);
    a.field = sphi_vector_at(parts, s->field, i);
    return a;
}
SPH_FN sph_index sphi_mhd_range(int uniform, int parts, int cleans, sph_kernel k, int dim, sph_cloud cloud,
                                const sph_mhd *s, const sph_mhd_out *out)
{
    const sph_real support = sph_kernel_support_ratio(k);
    const size_t stride = sphi_stride(out->stride);
    sph_real v_sig[SPHI_TILE];
    sph_mhd_terms terms;
    sph_index i, p, tile, end, failed = 0;
    terms.beta = s->beta;
    terms.alpha_u = s->alpha_u;
    terms.parts = parts;
    terms.cleans = cleans;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_mhd_side own = sphi_mhd_side(parts, cleans, s, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0), tension = SPH_R(0), sv = SPH_R(0),
                 sB = SPH_R(0), heat = SPH_R(0);
        sph_real ix = SPH_R(0), iy = SPH_R(0), iz = SPH_R(0), cx = SPH_R(0), cy = SPH_R(0), cz = SPH_R(0),
                 rx = SPH_R(0), ry = SPH_R(0), rz = SPH_R(0);
        sph_mhd_sums sums;
        sph_mhd_change change;
        int lost;
        sums.speed = sph_mhd_fast_speed(own.cs, own.field, own.medium.rho, SPH_R(0));
        for (tile = cloud.list.start[i]; tile < cloud.list.start[i + 1]; tile = end) {
            end = cloud.list.start[i + 1] - tile < SPHI_TILE ? cloud.list.start[i + 1] : tile + SPHI_TILE;
            SPH_SUM(p, tile, end, ax, ay, az, tension, sv, sB, heat, ix, iy, iz, cx, cy, cz, rx, ry, rz) {
                const sph_index j = cloud.list.index[p];
                const sph_vec x_ij =
                    sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
                const sph_pair_kernel f = sphi_pair_kernel(k, dim, uniform, x_ij, h_i, cloud.h, j);
                const sph_mhd_sums c =
                    sph_mhd_pair(dim, terms, own, sphi_mhd_side(parts, cleans, s, j), f, x_ij);
                const sph_real h_j = uniform ? h_i : sphi_at(cloud.h, j);
                ax += c.force.x;
                ay += c.force.y;
                az += c.force.z;
                ix += c.stretching.x;
                iy += c.stretching.y;
                iz += c.stretching.z;
                if (cleans) {
                    cx += c.cleaning.x;
                    cy += c.cleaning.y;
                    cz += c.cleaning.z;
                }
                rx += c.resistivity.x;
                ry += c.resistivity.y;
                rz += c.resistivity.z;
                tension += c.tension;
                sv += c.div_v;
                sB += c.div_B;
                heat += c.heat;
                v_sig[p - tile] = c.speed * sphi_within(support, h_i, h_j, f.r);
            }
            sums.speed = sphi_largest(sums.speed, v_sig, (int)(end - tile));
        }
        sums.force.x = ax;
        sums.force.y = ay;
        sums.force.z = az;
        sums.stretching.x = ix;
        sums.stretching.y = iy;
        sums.stretching.z = iz;
        sums.cleaning.x = cx;
        sums.cleaning.y = cy;
        sums.cleaning.z = cz;
        sums.resistivity.x = rx;
        sums.resistivity.y = ry;
        sums.resistivity.z = rz;
        sums.tension = tension;
        sums.div_v = sv;
        sums.div_B = sB;
        sums.heat = heat;
        change = sph_mhd_value(own, sums, s->tensile,
                               sphi_cleaning_wave(cleans ? s->ch : SPH_R(0), s->sigma, h_i));
        lost = sphi_store_vector(parts, out->acceleration, i, change.acceleration);
        lost |= sphi_store_vector(parts, out->rate_B, i, change.rate_B);
        lost |= sphi_put(out->rate_u, stride, i, change.rate_u);
        lost |= sphi_put(out->rate_psi, stride, i, change.rate_psi);
        lost |= sphi_put(out->div_B, stride, i, change.div_B);
        lost |= sphi_put(out->div_v, stride, i, change.div_v);
        lost |= sphi_put(out->v_sig, stride, i, sums.speed);
        sphi_tell(out->status, i, lost);
        failed += lost;
    }
    return failed;
}
/* Chooses the loop, for which parts, cleans and the kind of h are constants. */
SPH_FN sph_index sphi_mhd_some(int parts, int cleans, sph_kernel k, int dim, sph_cloud cloud,
                               const sph_mhd *s, const sph_mhd_out *out)
{
    if (cleans)
        return cloud.h.stride ? sphi_mhd_range(0, parts, 1, k, dim, cloud, s, out)
                              : sphi_mhd_range(1, parts, 1, k, dim, cloud, s, out);
    return cloud.h.stride ? sphi_mhd_range(0, parts, 0, k, dim, cloud, s, out)
                          : sphi_mhd_range(1, parts, 0, k, dim, cloud, s, out);
}
/* All rates of a magnetised gas in one pass:
     dv/dt    (6), less `tensile` times (9); artificial viscosity alpha v_sig where particles approach.
     dB/dt    (7), for B itself; -grad psi, (23); artificial resistivity, (10).
     du/dt    P / (Omega rho^2) sum_j m_j v_ij . grad_i W_ij; heating by viscosity and resistivity (both >=
              0); conductivity.
     dpsi/dt  (2), (25).
     div B    the difference form (20); so is div v.
   The density comes from sph_density_adaptive; its rate is -rho div v. With tensile = 0 the energy sum m
   (v^2/2 + u + B^2 / (2 rho) + psi^2 / (2 rho ch^2)) changes by the damping of psi only, and the momentum
   does not change, both to round-off. With (9) the momentum changes at the rate -tensile sum (m / rho) B
   (div B), with div B in symmetric form. v_sig is the largest signal speed of a target with its neighbours
   within the larger of the two supports, for time steps and switches. It is not below the target's own
   fast speed across the field. */
SPH_FN sph_index sph_mhd_rates(sph_kernel k, int dim, sph_cloud cloud, sph_mhd state, sph_mhd_out out)
{
    const int parts = sphi_components(dim, state.v), cleans = state.psi.p != 0;
    int error = sphi_check_medium(k, dim, cloud, state.medium, cloud.points.n);
    if (!error) error = sphi_check_field("p", state.p, cloud.points.n);
    if (!error) error = sphi_check_not_negative("cs", state.cs, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", parts, state.v, cloud.points.n);
    if (!error) error = sphi_check_vectors("field", parts, state.field, cloud.points.n);
    if (!error && !sphi_finite(state.beta)) error = sphi_refuse("state.beta", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_field("u", state.u, cloud.points.n);
    if (!error) error = sphi_check_field("alpha", state.alpha, cloud.points.n);
    if (!error) error = sphi_check_field("alpha_B", state.alpha_B, cloud.points.n);
    if (!error && cleans) error = sphi_check_field("psi", state.psi, cloud.points.n);
    if (!error) error = sphi_check_out("acceleration", parts, out.acceleration);
    if (!error) error = sphi_check_out("rate_B", parts, out.rate_B);
    if (!error && (!sphi_finite(state.ch) || state.ch < SPH_R(0) || !sphi_finite(state.sigma) ||
                   state.sigma < SPH_R(0)))
        error = sphi_refuse("state.ch, sigma", -1, SPH_ERROR_VALUE);
    if (!error && (!sphi_finite(state.alpha_u) || !sphi_finite(state.tensile)))
        error = sphi_refuse("state.alpha_u, tensile", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    if (parts == dim) return sphi_mhd_some(dim, cleans, k, dim, cloud, &state, &out);
    return sphi_mhd_some(3, cleans, k, dim, cloud, &state, &out);
}

/* ================================================================ reproducing kernels
 *
 * A reproducing kernel of first order is the kernel times a linear function, which makes sums exact for
 * linear fields. With x = x_ij and the particle itself in all sums (x = 0, so that it counts in m0):
 *     m0 = sum_j V_j W,   m1 = sum_j V_j x W,   m2 = sum_j V_j x x^T W,
 *     B = -m2^-1 m1,      A = 1 / (m0 + B . m1),
 *     W^R_ij = A_i (1 + B_i . x_ij) W_ij.
 * Its gradient is that by x_i, with the derivatives of A and B in it:
 *     d_c W^R = A (1 + B . x) d_c W + d_c A (1 + B . x) W + A (d_c B . x + B_c) W.
 * At every particle whose neighbours are not all on one line (in 3D, in one plane) with it, at boundaries,
 * too:
 *     sum_j V_j W^R = 1,  sum_j V_j x W^R = 0,  sum_j V_j grad W^R = 0,  sum_j V_j x (grad W^R)^T = -1.
 *
 * The order of a step: volumes, then sph_rk_correction, which stores A, B and their derivatives (1 + 2 dim +
 * dim^2 numbers), then whatever uses them.
 *
 * A gas takes pair forces from such gradients that conserve momentum and energy to round-off:
 *     CRK   m_i a_i = -1/2 sum_j V_i V_j (P_i + P_j + Q_ij) (grad W^R_ij - grad W^R_ji),
 *     IAD   a_i     = -sum_j m_j (P_i / rho_i^2 A_i + P_j / rho_j^2 A_j),
 * where A_i = C_i x_ji W_ij(h_i) and A_j = C_j x_ji W_ij(h_j) (see sph_gradient_iad). What conservation
 * costs, on 80 x 80 particles in a periodic box (cubic spline, h = 1.4 dx, V = 1 / sum W): the force that is
 * left of a uniform pressure, rms of |a| h rho / P, means of three seeds (tests/test_conservation_cost.c).
 *                               jitter 0.2 dx   300 shifts   300 shifts, tensile term
 *     P / rho^2, symmetric          0.160         0.0060         0.0019
 *     CRK pair                      0.071         0.0070         0.0003
 *     IAD pair                      0.243         0.0185         0.0005
 *     gradients by differences      0             0              0
 * So the CRK pair is better than plain SPH in disorder and near a lattice, where IAD is, too, but not exact.
 * IAD is worse than plain SPH in disorder, and both are where particles were moved until the plain force of a
 * uniform pressure was small, which is what shifting by the concentration does. In these units the numbers do
 * not fall with more particles: the force of a pressure is right to order 0 only, as in all conservative SPH.
 * Gradients by differences (sph_gradient_rk, sph_gradient_iad) are exact there, but do not conserve momentum.
 * Neither pair force acts along the line between the particles, so that angular momentum is not conserved;
 * under a uniform pressure the torque of the CRK pairs on an open cloud is 0, because sum_j V_j x (grad
 * W^R)^T is symmetric.
 *
 * Sources: Liu, Jun & Zhang 1995, IJNMF 20, 1081 (reproducing kernels); Bonet & Kulasegaram 2000, IJNME 47,
 * 1189 (derivatives); Frontiere, Raskin & Owen 2017, JCP 332, 160 (the conservative form); Garcia-Senz,
 * Cabezon & Escartin 2012, A&A 538, A9 (IAD).
 */

/* -------- reproducing kernels: types and pair functions */

/* A symmetric tensor of third order. */
typedef struct sph_sym_third {
    sph_real xxx, xxy, xyy, yyy, xxz, xyz, yyz, xzz, yzz, zzz;
} sph_sym_third;
/* The moments of a particle, with x = x_ij: m0 = sum V W, m1 = sum V x W, m2 = sum V x x W, and the same with
   F in the place of W, with one x more: f1 = sum V x F, f2 = sum V x x F, f3 = sum V x x x F. */
typedef struct sph_rk_moments {
    sph_real m0;
    sph_vec m1, f1;
    sph_sym m2, f2;
    sph_sym_third f3;
} sph_rk_moments;
/* What makes the kernel of a particle a reproducing one: A, B, the gradient of A, and that of B, the row of
   each component of B. */
typedef struct sph_rk_side {
    sph_real scale;
    sph_vec slope, scale_gradient;
    sph_mat slope_gradient;
} sph_rk_side;
/* W^R and its gradient. */
typedef struct sph_rk_kernel {
    sph_real w;
    sph_vec gradient;
} sph_rk_kernel;

/* What j, with the volume V_j, adds to the moments of i. w is W and F at the distance |x_ij| and with h_i.
   The particle itself adds the same with x_ij = 0. Entries beyond dim are 0. */
SPH_FN sph_rk_moments sph_rk_moments_pair(int dim, sph_real V_j, sph_vec x_ij, sph_wf w)
{
    const sph_real vw = V_j * w.w, vf = V_j * w.f, x = x_ij.x, y = dim > 1 ? x_ij.y : SPH_R(0),
                   z = dim > 2 ? x_ij.z : SPH_R(0);
    sph_rk_moments m;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    m.m0 = vw;
    m.m1.x = vw * x;
    m.f1.x = vf * x;
    m.m2.xx = m.m1.x * x;
    m.f2.xx = m.f1.x * x;
    m.f3.xxx = m.f2.xx * x;
    m.m1.y = m.f1.y = m.m2.xy = m.m2.yy = m.f2.xy = m.f2.yy = m.f3.xxy = m.f3.xyy = m.f3.yyy = SPH_R(0);
    m.m1.z = m.f1.z = m.m2.xz = m.m2.yz = m.m2.zz = m.f2.xz = m.f2.yz = m.f2.zz = SPH_R(0);
    m.f3.xxz = m.f3.xyz = m.f3.yyz = m.f3.xzz = m.f3.yzz = m.f3.zzz = SPH_R(0);
    if (dim > 1) {
        m.m1.y = vw * y;
        m.f1.y = vf * y;
        m.m2.xy = m.m1.x * y;
        m.m2.yy = m.m1.y * y;
        m.f2.xy = m.f1.x * y;
        m.f2.yy = m.f1.y * y;
        m.f3.xxy = m.f2.xx * y;
        m.f3.xyy = m.f2.xy * y;
        m.f3.yyy = m.f2.yy * y;
    }
    if (dim > 2) {
        m.m1.z = vw * z;
        m.f1.z = vf * z;
        m.m2.xz = m.m1.x * z;
        m.m2.yz = m.m1.y * z;
        m.m2.zz = m.m1.z * z;
        m.f2.xz = m.f1.x * z;
        m.f2.yz = m.f1.y * z;
        m.f2.zz = m.f1.z * z;
        m.f3.xxz = m.f2.xx * z;
        m.f3.xyz = m.f2.xy * z;
        m.f3.yyz = m.f2.yy * z;
        m.f3.xzz = m.f2.xz * z;
        m.f3.yzz = m.f2.yz * z;
        m.f3.zzz = m.f2.zz * z;
    }
    return m;
}
/* sum_b f3_abc B_b, a symmetric tensor. */
SPH_FN sph_sym sphi_third_times(int dim, sph_sym_third t, sph_vec b)
{
    sph_sym s;
    s.xx = t.xxx * b.x;
    s.xy = s.yy = s.xz = s.yz = s.zz = SPH_R(0);
    if (dim > 1) {
        s.xx += t.xxy * b.y;
        s.xy = t.xxy * b.x + t.xyy * b.y;
        s.yy = t.xyy * b.x + t.yyy * b.y;
    }
    if (dim > 2) {
        s.xx += t.xxz * b.z;
        s.xy += t.xyz * b.z;
        s.yy += t.yyz * b.z;
        s.xz = t.xxz * b.x + t.xyz * b.y + t.xzz * b.z;
        s.yz = t.xyz * b.x + t.yyz * b.y + t.yzz * b.z;
        s.zz = t.xzz * b.x + t.yzz * b.y + t.zzz * b.z;
    }
    return s;
}
/* *side from the moments. Returns SPH_OK; SPH_FELL_BACK where m2 is singular, or A would be larger than any
   number means: then B = 0 and A = 1 / m0, which is Shepard's correction, exact for constants only; or
   SPH_TOO_FEW if m0 is not positive, and then *side is 0. *conditioning is the smaller of two numbers in [0,
   1]: the smallest pivot of m2 scaled to a unit diagonal, and 1 / (A m0). */
SPH_FN int sph_rk_solve(int dim, sph_rk_moments m, sph_rk_side *side, sph_real *conditioning)
{
    sph_sym inverse = {SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0), SPH_R(0)};
    sph_vec row;
    sph_mat q;
    sph_real per, pivot = SPH_R(0);
    int state;
    side->scale = *conditioning = SPH_R(0);
    row.x = row.y = row.z = SPH_R(0);
    side->slope = side->scale_gradient = row;
    side->slope_gradient.x = side->slope_gradient.y = side->slope_gradient.z = row;
    if (!(m.m0 > SPH_R(0))) return SPH_TOO_FEW;
    state = sph_solve_gradient(dim, m.m2, &inverse, &pivot);
    if (!state) side->slope = sph_scale(SPH_R(-1), sphi_sym_times(dim, inverse, m.m1));
    per = m.m0 + sph_dot(dim, side->slope, m.m1); /* 1 / A */
    if (state || !(per > SPHI_PIVOT_MIN * m.m0)) {
        side->slope = row;
        side->scale = SPH_R(1) / m.m0;
        side->scale_gradient = sph_scale(-side->scale * side->scale, m.f1);
        if (dim < 2) side->scale_gradient.y = SPH_R(0);
        if (dim < 3) side->scale_gradient.z = SPH_R(0);
        return SPH_FELL_BACK;
    }
    *conditioning = per < pivot * m.m0 ? per / m.m0 : pivot;
    side->scale = SPH_R(1) / per;
    /* q_ac = d_c m2_ab B_b + d_c m1_a, of which d_c B = -m2^-1 (column c of q) */
    q = sph_mat_of_sym(dim, sphi_third_times(dim, m.f3, side->slope));
    q.x.x += m.f2.xx + per + m.m1.x * side->slope.x;
    if (dim > 1) {
        q.x.y += m.f2.xy + m.m1.x * side->slope.y;
        q.y.x += m.f2.xy + m.m1.y * side->slope.x;
        q.y.y += m.f2.yy + per + m.m1.y * side->slope.y;
    }
    if (dim > 2) {
        q.x.z += m.f2.xz + m.m1.x * side->slope.z;
        q.y.z += m.f2.yz + m.m1.y * side->slope.z;
        q.z.x += m.f2.xz + m.m1.z * side->slope.x;
        q.z.y += m.f2.yz + m.m1.z * side->slope.y;
        q.z.z += m.f2.zz + per + m.m1.z * side->slope.z;
    }
    q = sph_mat_transposed(dim, q);
    q.x = sph_scale(SPH_R(-1), sphi_sym_times(dim, inverse, q.x)); /* d_x B, and so on */
    q.y = sph_scale(SPH_R(-1), sphi_sym_times(dim, inverse, q.y));
    q.z = sph_scale(SPH_R(-1), sphi_sym_times(dim, inverse, q.z));
    side->slope_gradient = sph_mat_transposed(dim, q);
    row = sphi_plus(dim, sph_mat_times(dim, q, m.m1), sphi_sym_times(dim, m.f2, side->slope));
    row = sphi_plus(dim, row, sphi_plus(dim, m.f1, sph_scale(m.m0, side->slope)));
    side->scale_gradient = sph_scale(-side->scale * side->scale, row);
    if (dim < 2) side->scale_gradient.y = SPH_R(0);
    if (dim < 3) side->scale_gradient.z = SPH_R(0);
    return SPH_OK;
}
/* W^R_ij of particle i and its gradient by x_i. w is W and F at the distance |x_ij| and with h_i. For the
   kernel of j, W^R_ji and its gradient by x_j, give the side of j, -x_ij, and h_j. */
SPH_FN sph_rk_kernel sph_rk_pair(int dim, sph_rk_side i, sph_vec x_ij, sph_wf w)
{
    const sph_real line = SPH_R(1) + sph_dot(dim, i.slope, x_ij), along = i.scale * line * w.f;
    sph_vec turn = sph_scale(x_ij.x, i.slope_gradient.x); /* d_c B . x */
    sph_rk_kernel c;
    if (dim > 1) turn = sphi_plus(dim, turn, sph_scale(x_ij.y, i.slope_gradient.y));
    if (dim > 2) turn = sphi_plus(dim, turn, sph_scale(x_ij.z, i.slope_gradient.z));
    turn = sphi_plus(dim, turn, i.slope);
    c.w = i.scale * line * w.w;
    c.gradient.x = along * x_ij.x + w.w * (line * i.scale_gradient.x + i.scale * turn.x);
    c.gradient.y = c.gradient.z = SPH_R(0);
    if (dim > 1) c.gradient.y = along * x_ij.y + w.w * (line * i.scale_gradient.y + i.scale * turn.y);
    if (dim > 2) c.gradient.z = along * x_ij.z + w.w * (line * i.scale_gradient.z + i.scale * turn.z);
    return c;
}
/* grad W^R_ij - grad W^R_ji, which is antisymmetric: minus itself if the particles are exchanged. For plain
   kernels it is twice grad_i W. w_i is with h_i, w_j with h_j. */
SPH_FN sph_vec sph_rk_pair_difference(int dim, sph_rk_side i, sph_rk_side j, sph_vec x_ij, sph_wf w_i,
                                      sph_wf w_j)
{
    return sph_subtract(dim, sph_rk_pair(dim, i, x_ij, w_i).gradient,
                        sph_rk_pair(dim, j, sph_scale(SPH_R(-1), x_ij), w_j).gradient);
}
/* C x_ji W = -C x_ij W, the vector of IAD that takes the place of grad_i W. inverse is C of i and w_ij is W
   with h_i, or both are those of j. */
SPH_FN sph_vec sph_gradient_pair_iad(int dim, sph_mat inverse, sph_vec x_ij, sph_real w_ij)
{
    return sph_scale(-w_ij, sph_mat_times(dim, inverse, x_ij));
}

/* What j adds to the rates of i: dv/dt, and du/dt by pressure and viscosity. */
typedef struct sph_corrected_change {
    sph_vec acceleration;
    sph_real rate_u;
} sph_corrected_change;
/* Of CRKSPH, with the difference of sph_rk_pair_difference and volumes = V_i V_j:
       a_i += -volumes / (2 m_i) (P_i + P_j + rho_i rho_j Pi_ij) difference,
       du_i/dt += volumes / (2 m_i) (P_j + rho_i rho_j Pi_ij / 2) v_ij . difference.
   Frontiere, Raskin & Owen 2017. viscosity is Pi_ij. With the partner's pressure in du/dt, energy is
   conserved: sum m (v . a + du/dt) = 0. Needs m > 0. */
SPH_FN sph_corrected_change sph_gas_pair_crk(int dim, sph_fluid_side i, sph_fluid_side j, sph_real volumes,
                                             sph_vec difference, sph_vec v_ij, sph_real viscosity)
{
    const sph_real weight = SPH_R(0.5) * volumes / i.m, q = i.rho * j.rho * viscosity;
    sph_corrected_change c;
    SPH_ASSERT(i.m > SPH_R(0));
    c.acceleration = sph_scale(-weight * (i.p + j.p + q), difference);
    c.rate_u = weight * (j.p + SPH_R(0.5) * q) * sph_dot(dim, v_ij, difference);
    return c;
}
/* Of IAD, with grad_i = A_i and grad_j = A_j by sph_gradient_pair_iad:
       a_i += -m_j (P_i / rho_i^2 A_i + P_j / rho_j^2 A_j + Pi_ij (A_i + A_j) / 2),
       du_i/dt += m_j v_ij . (P_i / rho_i^2 A_i + Pi_ij (A_i + A_j) / 4).
   Garcia-Senz, Cabezon & Escartin 2012. viscosity is Pi_ij. sum m (v . a + du/dt) = 0. Needs rho > 0 on both
   sides. */
SPH_FN sph_corrected_change sph_gas_pair_iad(int dim, sph_fluid_side i, sph_fluid_side j, sph_vec grad_i,
                                             sph_vec grad_j, sph_vec v_ij, sph_real viscosity)
{
    const sph_real p_i = j.m * i.p / (i.rho * i.rho), p_j = j.m * j.p / (j.rho * j.rho),
                   q = SPH_R(0.5) * j.m * viscosity;
    sph_corrected_change c;
    SPH_ASSERT(i.rho > SPH_R(0) && j.rho > SPH_R(0));
    c.acceleration =
        sph_scale(SPH_R(-1), sphi_plus(dim, sph_scale(p_i + q, grad_i), sph_scale(p_j + q, grad_j)));
    c.rate_u =
        (p_i + SPH_R(0.5) * q) * sph_dot(dim, v_ij, grad_i) + SPH_R(0.5) * q * sph_dot(dim, v_ij, grad_j);
    return c;
}

/* -------- reproducing kernels: sweeps */

/* A, B and their gradients of all sources: what sph_rk_correction wrote. Interpolation and gradients read
   those of the targets. */
typedef struct sph_rk {
    sph_scalars scale;
    sph_vectors slope, scale_gradient;
    sph_matrices slope_gradient;
} sph_rk;
/* Where they go. conditioning and status may be null. The stride is that of scale and conditioning. */
typedef struct sph_rk_out {
    SPH_GLOBAL sph_real *scale, *conditioning;
    size_t stride;
    sph_vector_out slope, scale_gradient;
    sph_matrix_out slope_gradient; /* the row of each component of B: its gradient */
    SPH_GLOBAL unsigned char *status;
} sph_rk_out;
/* Where the rates of a gas go: the acceleration, and du/dt by pressure and viscosity (u: thermal energy per
   mass). rate_u and status may be null. */
typedef struct sph_corrected_out {
    sph_vector_out acceleration;
    SPH_GLOBAL sph_real *rate_u;
    size_t stride; /* of rate_u */
    SPH_GLOBAL unsigned char *status;
} sph_corrected_out;

SPH_FN sph_rk_side sphi_rk_side(int dim, const sph_rk *a, sph_index i)
{
    sph_rk_side s;
    s.scale = sphi_at(a->scale, i);
    s.slope = sphi_vector_at(dim, a->slope, i);
    s.scale_gradient = sphi_vector_at(dim, a->scale_gradient, i);
    s.slope_gradient = sphi_matrix_at(dim, a->slope_gradient, i);
    return s;
}
SPH_FN int sphi_check_rk(int dim, sph_rk a, sph_index n)
{
    int error = sphi_check_field("rk.scale", a.scale, n);
    if (!error) error = sphi_check_vectors("rk.slope", dim, a.slope, n);
    if (!error) error = sphi_check_vectors("rk.scale_gradient", dim, a.scale_gradient, n);
    return error ? error : sphi_check_matrices("rk.slope_gradient", dim, a.slope_gradient, n);
}

/* A, B and their gradients for the targets (see the beginning of this chapter). The kernel of a particle has
   its own h_i. A target whose m2 is singular (its neighbours are on one line with it, in 3D in one plane, or
   it has none) is SPH_FELL_BACK: B = 0 and A = 1 / m0, exact for constants only. It is SPH_TOO_FEW, and all
   is 0, where m0 is not positive. conditioning: see sph_rk_solve. Where a number overflows, it is 0 with
   SPH_NOT_FINITE. */
SPH_FN sph_index sph_rk_correction(sph_kernel k, int dim, sph_cloud cloud, sph_rk_out out)
{
    const size_t stride = sphi_stride(out.stride);
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error && !out.scale) error = sphi_refuse("out.scale", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_out("out.slope", dim, out.slope);
    if (!error) error = sphi_check_out("out.scale_gradient", dim, out.scale_gradient);
    if (!error) error = sphi_check_matrix_out("out.slope_gradient", dim, out.slope_gradient);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), none = {SPH_R(0), SPH_R(0), SPH_R(0)};
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_rk_moments m =
            sph_rk_moments_pair(dim, sphi_at(cloud.volume, i), none, sph_kernel_wf(k, dim, SPH_R(0), h_i));
        sph_real m0 = m.m0, mx = SPH_R(0), my = SPH_R(0), mz = SPH_R(0), xx = SPH_R(0), xy = SPH_R(0),
                 yy = SPH_R(0), xz = SPH_R(0), yz = SPH_R(0), zz = SPH_R(0), fx = SPH_R(0), fy = SPH_R(0),
                 fz = SPH_R(0);
        sph_real gxx = SPH_R(0), gxy = SPH_R(0), gyy = SPH_R(0), gxz = SPH_R(0), gyz = SPH_R(0),
                 gzz = SPH_R(0), xxx = SPH_R(0), xxy = SPH_R(0), xyy = SPH_R(0), yyy = SPH_R(0),
                 xxz = SPH_R(0), xyz = SPH_R(0), yyz = SPH_R(0), xzz = SPH_R(0), yzz = SPH_R(0),
                 zzz = SPH_R(0);
        sph_rk_side side;
        sph_real conditioning;
        int state, lost;
        /* two loops, because a loop has 16 sums at most */
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], m0, mx, my, mz, xx, xy, yy, xz, yz, zz, fx,
                fy, fz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_rk_moments c = sph_rk_moments_pair(dim, sphi_at(cloud.volume, j), x_ij,
                                                         sph_kernel_wf(k, dim, sph_length(dim, x_ij), h_i));
            m0 += c.m0;
            mx += c.m1.x;
            xx += c.m2.xx;
            fx += c.f1.x;
            if (dim > 1) {
                my += c.m1.y;
                xy += c.m2.xy;
                yy += c.m2.yy;
                fy += c.f1.y;
            }
            if (dim > 2) {
                mz += c.m1.z;
                xz += c.m2.xz;
                yz += c.m2.yz;
                zz += c.m2.zz;
                fz += c.f1.z;
            }
        }
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], gxx, gxy, gyy, gxz, gyz, gzz, xxx, xxy, xyy,
                yyy, xxz, xyz, yyz, xzz, yzz, zzz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_rk_moments c = sph_rk_moments_pair(dim, sphi_at(cloud.volume, j), x_ij,
                                                         sph_kernel_wf(k, dim, sph_length(dim, x_ij), h_i));
            gxx += c.f2.xx;
            xxx += c.f3.xxx;
            if (dim > 1) {
                gxy += c.f2.xy;
                gyy += c.f2.yy;
                xxy += c.f3.xxy;
                xyy += c.f3.xyy;
                yyy += c.f3.yyy;
            }
            if (dim > 2) {
                gxz += c.f2.xz;
                gyz += c.f2.yz;
                gzz += c.f2.zz;
                xxz += c.f3.xxz;
                xyz += c.f3.xyz;
                yyz += c.f3.yyz;
                xzz += c.f3.xzz;
                yzz += c.f3.yzz;
                zzz += c.f3.zzz;
            }
        }
        m.m0 = m0;
        m.m1.x = mx, m.m1.y = my, m.m1.z = mz;
        m.m2.xx = xx, m.m2.xy = xy, m.m2.yy = yy, m.m2.xz = xz, m.m2.yz = yz, m.m2.zz = zz;
        m.f1.x = fx, m.f1.y = fy, m.f1.z = fz;
        m.f2.xx = gxx, m.f2.xy = gxy, m.f2.yy = gyy, m.f2.xz = gxz, m.f2.yz = gyz, m.f2.zz = gzz;
        m.f3.xxx = xxx, m.f3.xxy = xxy, m.f3.xyy = xyy, m.f3.yyy = yyy, m.f3.xxz = xxz, m.f3.xyz = xyz;
        m.f3.yyz = yyz, m.f3.xzz = xzz, m.f3.yzz = yzz, m.f3.zzz = zzz;
        state = sph_rk_solve(dim, m, &side, &conditioning);
        lost = sphi_put(out.scale, stride, i, side.scale);
        lost |= sphi_store_vector(dim, out.slope, i, side.slope);
        lost |= sphi_store_vector(dim, out.scale_gradient, i, side.scale_gradient);
        lost |= sphi_store_matrix(dim, out.slope_gradient, i, side.slope_gradient);
        if (lost) { /* the kernel of a part of them would be none */
            state = SPH_NOT_FINITE;
            sphi_put(out.scale, stride, i, SPH_R(0));
            sphi_store_vector(dim, out.slope, i, none);
            sphi_store_vector(dim, out.scale_gradient, i, none);
            side.slope_gradient.x = side.slope_gradient.y = side.slope_gradient.z = none;
            sphi_store_matrix(dim, out.slope_gradient, i, side.slope_gradient);
        }
        sphi_put(out.conditioning, stride, i, conditioning);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* f_i = sum_j V_j f_j W^R_ij, the particle itself included: exact for linear fields, error O(h^2), at
   boundaries, too. rk holds what sph_rk_correction wrote for the targets, of which A and B are read; those of
   the other sources are not. The result is 0 where A is 0 (SPH_TOO_FEW) or the sum overflows
   (SPH_NOT_FINITE).
   Atlas: value exact for linear fields; order 2 inside lattices, 2 in disorder, 2 at boundaries. */
SPH_FN sph_index sph_interpolate_rk(sph_kernel k, int dim, sph_cloud cloud, sph_rk rk, sph_scalars f,
                                    sph_scalar_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_rk(dim, rk, cloud.last);
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), none = {SPH_R(0), SPH_R(0), SPH_R(0)};
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_rk_side own = sphi_rk_side(dim, &rk, i);
        sph_real sum = sphi_at(cloud.volume, i) * sphi_at(f, i) *
                       sph_rk_pair(dim, own, none, sph_kernel_wf(k, dim, SPH_R(0), h_i)).w;
        int state = own.scale == SPH_R(0) ? SPH_TOO_FEW : SPH_OK;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sum) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            sum += sphi_at(cloud.volume, j) * sphi_at(f, j) *
                   sph_rk_pair(dim, own, x_ij, sph_kernel_wf(k, dim, sph_length(dim, x_ij), h_i)).w;
        }
        if (!sphi_finite(sum)) state = SPH_NOT_FINITE;
        failed += sphi_answer(out, i, state ? SPH_R(0) : sum, state);
    }
    return failed;
}
/* The same as rows: f_i = diagonal[i] f_i + sum_p row[p] f_j. diagonal[i] is what the particle itself adds;
   its sum with the row is 1. factor and conditioning are 1. Rows of targets without answer are 0. */
SPH_FN sph_index sph_interpolate_rows_rk(sph_kernel k, int dim, sph_cloud cloud, sph_rk rk, sph_rows_out out)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT row = out.row;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_rk(dim, rk, cloud.last);
    if (!error && !row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), none = {SPH_R(0), SPH_R(0), SPH_R(0)};
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_rk_side own = sphi_rk_side(dim, &rk, i);
        const sph_real self =
            sphi_at(cloud.volume, i) * sph_rk_pair(dim, own, none, sph_kernel_wf(k, dim, SPH_R(0), h_i)).w;
        int state = own.scale == SPH_R(0) ? SPH_TOO_FEW : SPH_OK;
        SPH_EACH(p, cloud.list.start[i], cloud.list.start[i + 1]) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            row[p] = sphi_at(cloud.volume, j) *
                     sph_rk_pair(dim, own, x_ij, sph_kernel_wf(k, dim, sph_length(dim, x_ij), h_i)).w;
        }
        if (sphi_row_finite(row, cloud.list.start[i], cloud.list.start[i + 1]) || !sphi_finite(self))
            state = SPH_NOT_FINITE;
        for (p = cloud.list.start[i]; state && p < cloud.list.start[i + 1]; p++) row[p] = SPH_R(0);
        sphi_put(out.diagonal, sphi_stride(out.stride), i, state ? SPH_R(0) : self);
        sphi_row_answer(out, cloud.list, i, 0, SPH_R(1), state);
        failed += state != SPH_OK;
    }
    return failed;
}
/* grad f_i = sum_j V_j (f_j - f_i) grad W^R_ij: exact for linear fields, error O(h^2) in the interior of a
   regular cloud and O(h) elsewhere. f_i drops out, because sum_j V_j grad W^R = 0. rk: as for
   sph_interpolate_rk. Where a component overflows, the gradient is 0 and the target counts as failed.
   Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 2 inside lattices, 1
   in disorder, 1 at boundaries. */
SPH_FN sph_index sph_gradient_rk(sph_kernel k, int dim, sph_cloud cloud, sph_rk rk, sph_scalars f,
                                 sph_vector_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_rk(dim, rk, cloud.last);
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error) error = sphi_check_out("out", dim, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), f_i = sphi_at(f, i);
        const sph_rk_side own = sphi_rk_side(dim, &rk, i);
        sph_real sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], sx, sy, sz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_vec g = sph_scale(
                sphi_at(cloud.volume, j) * (sphi_at(f, j) - f_i),
                sph_rk_pair(dim, own, x_ij, sph_kernel_wf(k, dim, sph_length(dim, x_ij), h_i)).gradient);
            sx += g.x;
            if (dim > 1) sy += g.y;
            if (dim > 2) sz += g.z;
        }
        sum.x = sx;
        sum.y = sy;
        sum.z = sz;
        failed += sphi_store_vector(dim, out, i, sum);
    }
    return failed;
}
/* The same as rows: grad f_i = sum_p (x[p], y[p], z[p]) (f_j - f_i). conditioning is 1. */
SPH_FN sph_index sph_gradient_rows_rk(sph_kernel k, int dim, sph_cloud cloud, sph_rk rk,
                                      sph_gradient_rows_out out)
{
    SPH_GLOBAL sph_real *const SPH_RESTRICT wx = out.x, *const SPH_RESTRICT wy = out.y,
                                            *const SPH_RESTRICT wz = out.z;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_rk(dim, rk, cloud.last);
    if (!error) error = sphi_check_out("out", dim, sph_vector_out_separate(wx, wy, wz));
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_rk_side own = sphi_rk_side(dim, &rk, i);
        int lost;
        SPH_EACH(p, cloud.list.start[i], cloud.list.start[i + 1]) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            const sph_vec g = sph_scale(
                sphi_at(cloud.volume, j),
                sph_rk_pair(dim, own, x_ij, sph_kernel_wf(k, dim, sph_length(dim, x_ij), h_i)).gradient);
            wx[p] = g.x;
            if (dim > 1) wy[p] = g.y;
            if (dim > 2) wz[p] = g.z;
        }
        lost = sphi_gradient_row_finite(dim, out, cloud.list, i, 0);
        sphi_put(out.conditioning, sphi_stride(out.stride), i, SPH_R(1));
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}

/* What both sweeps of gases check. n: of how many particles m is read. */
SPH_FN int sphi_check_corrected(sph_kernel k, int dim, sph_cloud cloud, sph_fluid f, sph_index n,
                                sph_vector_out a)
{
    int error = sphi_check_weights(k, dim, cloud, "m", f.m, n);
    if (!error && (f.viscosity < 0 || f.viscosity > (int)SPH_VISCOSITY_SIGNAL))
        error = sphi_refuse("fluid.viscosity", -1, SPH_ERROR_VALUE);
    if (!error && (!sphi_finite(f.alpha) || !sphi_finite(f.beta) || !sphi_finite(f.eta)))
        error = sphi_refuse("fluid.alpha, beta, eta", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_positive("m", f.m, n);
    if (!error) error = sphi_check_positive("rho", f.rho, cloud.points.n);
    if (!error) error = sphi_check_field("p", f.p, cloud.points.n);
    if (!error && f.viscosity != (int)SPH_VISCOSITY_NONE)
        error = sphi_check_not_negative("c", f.c, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, f.v, cloud.points.n);
    return error ? error : sphi_check_out("out.acceleration", dim, a);
}
/* One of the two corrections is read: rk, or inverse. */
SPH_FN sph_index sphi_corrected_range(int iad, int uniform, sph_kernel k, int dim, sph_cloud cloud,
                                      const sph_fluid *f, const sph_rk *rk, sph_matrices inverse,
                                      sph_corrected_out out)
{
    const int reads = SPHI_READ_M + SPHI_READ_RHO + SPHI_READ_P;
    const int viscous = f->viscosity != (int)SPH_VISCOSITY_NONE;
    sph_viscosity_terms terms;
    sph_index i, p, failed = 0;
    terms.alpha = f->alpha;
    terms.beta = f->beta;
    terms.eta = sphi_softening(f->eta);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, f->v, i);
        const sph_real h_i = sphi_at(cloud.h, i), c_i = viscous ? sphi_at(f->c, i) : SPH_R(0),
                       V_i = iad ? SPH_R(0) : sphi_at(cloud.volume, i);
        const sph_fluid_side own = sphi_fluid_side(reads, f, f->m, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0), rate = SPH_R(0);
        sph_rk_side own_rk;
        sph_mat own_inverse;
        sph_vec sum;
        int lost;
        if (iad) own_inverse = sphi_matrix_at(dim, inverse, i);
        else own_rk = sphi_rk_side(dim, rk, i);
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az, rate) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          v_ij = sph_subtract(dim, v_i, sphi_vector_at(dim, f->v, j));
            const sph_fluid_side other = sphi_fluid_side(reads, f, f->m, j);
            sph_corrected_change c;
            sph_encounter e;
            sph_wf w_i, w_j;
            sph_real viscosity;
            e.vx = sph_dot(dim, v_ij, x_ij);
            e.r = sph_length(dim, x_ij);
            e.h = sphi_mean_h(uniform, cloud.h, h_i, j);
            e.c = viscous ? SPH_R(0.5) * (c_i + sphi_at(f->c, j)) : SPH_R(0);
            e.rho = SPH_R(0.5) * (own.rho + other.rho);
            viscosity = sphi_fluid_viscosity(f->viscosity, terms, e);
            w_i = sph_kernel_wf(k, dim, e.r, h_i);
            w_j = uniform ? w_i : sph_kernel_wf(k, dim, e.r, sphi_at(cloud.h, j));
            if (iad)
                c = sph_gas_pair_iad(dim, own, other, sph_gradient_pair_iad(dim, own_inverse, x_ij, w_i.w),
                                     sph_gradient_pair_iad(dim, sphi_matrix_at(dim, inverse, j), x_ij, w_j.w),
                                     v_ij, viscosity);
            else
                c = sph_gas_pair_crk(
                    dim, own, other, V_i * sphi_at(cloud.volume, j),
                    sph_rk_pair_difference(dim, own_rk, sphi_rk_side(dim, rk, j), x_ij, w_i, w_j), v_ij,
                    viscosity);
            ax += c.acceleration.x;
            if (dim > 1) ay += c.acceleration.y;
            if (dim > 2) az += c.acceleration.z;
            rate += c.rate_u;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        lost = sphi_store_vector(dim, out.acceleration, i, sum);
        lost |= sphi_put(out.rate_u, sphi_stride(out.stride), i, rate);
        sphi_tell(out.status, i, lost);
        failed += lost;
    }
    return failed;
}
/* Acceleration and du/dt of a gas by reproducing kernels (CRKSPH): the sums of sph_gas_pair_crk. Frontiere,
   Raskin & Owen 2017, JCP 332, 160, without their limiter of the viscosity. Momentum, and the energy sum m
   (v^2/2 + u), do not change, to round-off. What that costs: see the beginning of this chapter. Of fluid all
   members are read (m of the targets); c only with artificial viscosity, whose kind and coefficients are
   those of fluid. Its heating may be negative for single pairs, where the difference of the gradients is far
   from the line between the particles. Volumes are those that sph_rk_correction saw (1 / sum W, or m / rho),
   and rk holds its results for all sources. Lists hold all pairs with r < support ratio * max(h_i, h_j)
   (SPH_LARGER). out.rate_u and out.status may be null. Returns the number of targets of which a result
   overflowed (it is 0 then), or a negative sph_error: SPH_ERROR_VALUE also for masses, densities and volumes
   that are not positive.
   Atlas: gradient exact for nothing, inside lattices for quadratic fields; order 2 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_gas_rates_crk(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid, sph_rk rk,
                                   sph_corrected_out out)
{
    const sph_matrices none = sph_matrices_packed(dim, 0);
    int error = sphi_check_corrected(k, dim, cloud, fluid, cloud.last, out.acceleration);
    if (!error) error = sphi_check_positive("volume", cloud.volume, cloud.points.n);
    if (!error) error = sphi_check_rk(dim, rk, cloud.points.n);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_corrected_range(0, 0, k, dim, cloud, &fluid, &rk, none, out)
                          : sphi_corrected_range(0, 1, k, dim, cloud, &fluid, &rk, none, out);
}
/* The same by the integral approach (IAD): the sums of sph_gas_pair_iad. Garcia-Senz, Cabezon & Escartin
   2012, A&A 538, A9. inverse: C of all sources, by sph_gradient_correction_iad. With h that follows the
   density, give p / Omega for the pressure (the papers on IAD set Omega aside). Volumes are not read. On
   particles without order its error is larger than that of plain SPH.
   Atlas: gradient exact for nothing, inside lattices for quadratic fields; order 2 inside lattices, -1 in
   disorder, -1 at boundaries. */
SPH_FN sph_index sph_gas_rates_iad(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                   sph_matrices inverse, sph_corrected_out out)
{
    const sph_rk *const none = 0;
    int error = sphi_check_corrected(k, dim, cloud, fluid, cloud.points.n, out.acceleration);
    if (!error) error = sphi_check_matrices("inverse", dim, inverse, cloud.points.n);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_corrected_range(1, 0, k, dim, cloud, &fluid, none, inverse, out)
                          : sphi_corrected_range(1, 1, k, dim, cloud, &fluid, none, inverse, out);
}

/* ================================================================ gravity, three dimensions
 *
 * The gravitational energy is
 *     E = G/2 sum_i sum_j m_i m_j (phi(r, h_i) + phi(r, h_j)) / 2,
 * with the particle itself, where phi < 0 is the potential of a unit mass that is spread out like the kernel
 * (chapter gravity of sph_kernels.h). If h follows the density, E depends on h, too. Forces then have a
 * second part (sph_gravity_correction), without which energy is not conserved.
 *
 * Source: Price & Monaghan 2007, MNRAS 374, 1347. Only kernels with sph_kernel_has_gravity; the sweeps that
 * need phi answer SPH_ERROR_KERNEL for others.
 */

/* -------- gravity: pair functions */

/* The mean of (1/r) dphi/dr with h_i and with h_j, >= 0: a_i = -G sum_j m_j sph_gravity_pair x_ij. Beyond
   both supports it is Newton's 1/r^3. Coincident particles feel no force, because x_ij = 0. Needs a kernel
   with sph_kernel_has_gravity. */
SPH_FN sph_real sph_gravity_pair(sph_kernel k, sph_real r, sph_real h_i, sph_real h_j)
{
    return SPH_R(0.5) * (sph_gravity_force(k, r, h_i) + sph_gravity_force(k, r, h_j));
}
/* What gravity adds where h follows the density: (zeta_i F_i / Omega_i + zeta_j F_j / Omega_j) / 2, the
   coefficient of -G m_j x_ij in the acceleration of i. scaled_i = zeta_i / Omega_i and scaled_j likewise;
   zeta comes from sph_gravity_zeta_value. Price & Monaghan 2007, MNRAS 374, 1347. */
SPH_FN sph_real sph_gravity_correction_pair(sph_pair_kernel f, sph_real scaled_i, sph_real scaled_j)
{
    return SPH_R(0.5) * (scaled_i * f.f_i + scaled_j * f.f_j);
}
/* zeta_i = dh_i/drho_i sum_j m_j dphi/dh(r, h_i) with dh/drho = -h / (3 rho): Price & Monaghan 2007, (22).
   The sum contains the particle itself. Needs rho > 0. */
SPH_FN sph_real sph_gravity_zeta_value(sph_real h, sph_real rho, sph_real sum)
{
    SPH_ASSERT(h > SPH_R(0) && rho > SPH_R(0));
    return -h / (SPH_R(3) * rho) * sum;
}

/* -------- gravity: sweeps */

SPH_FN int sphi_check_gravity(sph_kernel k, sph_cloud cloud, sph_scalars m, sph_real newton)
{
    sph_real largest = SPH_R(0);
    int error = sphi_check_targets(3, cloud);
    if (error >= 0 && !sph_kernel_has_gravity(k)) return sphi_refuse("kernel", -1, SPH_ERROR_KERNEL);
    if (!error) error = sphi_check_arrays(3, cloud.points);
    if (!error && !sphi_finite(newton)) error = sphi_refuse("newton", -1, SPH_ERROR_VALUE);
    if (!error && !cloud.h.p) error = sphi_refuse("h", -1, SPH_ERROR_NULL);
    if (!error && cloud.checked != 1) error = sphi_check_h("h", cloud.h, cloud.points.n, &largest);
    if (!error && cloud.checked != 1) error = sphi_check_positions(3, cloud.points);
    return error ? error : sphi_check_field("m", m, cloud.points.n);
}
/* Acceleration -G sum_j m_j sph_gravity_pair x_ij and potential G sum_j m_j (phi(r, h_i) + phi(r, h_j)) /
   2 of the targets. newton is G. The sums run over all sources, with the particle itself: n^2 steps, for
   small clouds and to measure trees against. No list is read. The cloud is isolated: the lengths of the
   box are not used. Momentum is conserved to round-off. potential may be without an array. Returns the
   number of targets of which a result overflowed (it is 0 then), or a negative sph_error.
   Atlas: keeps momentum and angular momentum; energy is kept. */
SPH_FN sph_index sph_gravity_direct(sph_kernel k, sph_cloud cloud, sph_scalars m, sph_real newton,
                                    sph_vector_out acceleration, sph_scalar_out potential)
{
    const sph_points x = cloud.points;
    const sph_scalars h = cloud.h;
    int error = sphi_check_gravity(k, cloud, m, newton);
    sph_index i, j, failed = 0;
    if (!error) error = sphi_check_out("acceleration", 3, acceleration);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(3, x, i);
        const sph_real h_i = sphi_at(h, i);
        sph_vec a = {SPH_R(0), SPH_R(0), SPH_R(0)};
        sph_real phi = SPH_R(0);
        int lost;
        for (j = 0; j < x.n; j++) {
            const sph_vec x_ij = sph_subtract(3, x_i, sphi_point(3, x, j));
            const sph_real r = sph_length(3, x_ij), m_j = sphi_at(m, j), h_j = sphi_at(h, j);
            a = sph_subtract(3, a, sph_scale(newton * m_j * sph_gravity_pair(k, r, h_i, h_j), x_ij));
            phi += SPH_R(0.5) * newton * m_j *
                   (sph_gravity_potential(k, r, h_i) + sph_gravity_potential(k, r, h_j));
        }
        lost = sphi_store_vector(3, acceleration, i, a) | !sphi_finite(phi);
        if (potential.p)
            sphi_answer(potential, i, sphi_finite(phi) ? phi : SPH_R(0),
                        lost ? (int)SPH_NOT_FINITE : (int)SPH_OK);
        failed += lost;
    }
    return failed;
}
/* zeta_i = dh_i/drho_i sum_j m_j dphi/dh(r, h_i) with dh/drho = -h / (3 rho): Price & Monaghan 2007, (22).
   The sum contains the particle itself; rho is of the targets. Lists as for the density: r < support ratio *
   h_i. Returns the number of targets whose result overflowed (it is 0 then), or a negative sph_error. */
SPH_FN sph_index sph_gravity_zeta(sph_kernel k, sph_cloud cloud, sph_scalars m, sph_scalars rho,
                                  sph_scalar_out out)
{
    int error = sphi_check_sweep(k, 3, cloud, "m", m);
    sph_index i, p, failed = 0;
    if (error >= 0 && !sph_kernel_has_gravity(k)) error = sphi_refuse("kernel", -1, SPH_ERROR_KERNEL);
    if (!error) error = sphi_check_positive("rho", rho, cloud.last);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(3, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real sum = sphi_at(m, i) * sph_gravity_dphidh(k, SPH_R(0), h_i);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++)
            sum += sphi_at(m, cloud.list.index[p]) *
                   sph_gravity_dphidh(
                       k,
                       sph_length(3, sphi_separation(3, cloud.points, x_i,
                                                     sphi_point(3, cloud.points, cloud.list.index[p]))),
                       h_i);
        failed += sphi_store(out, i, sph_gravity_zeta_value(h_i, sphi_at(rho, i), sum));
    }
    return failed;
}
/* What gravity adds to the acceleration where h follows the density:
       -(G/2) sum_j m_j (zeta_i F_i / Omega_i + zeta_j F_j / Omega_j) x_ij,
   antisymmetric for each pair. newton is G; zeta comes from sph_gravity_zeta; rho is not read. Lists of all
   pairs within the larger support (SPH_LARGER). Returns the number of targets whose result overflowed
   (it is 0 then), or a negative sph_error. */
SPH_FN sph_index sph_gravity_correction(sph_kernel k, sph_cloud cloud, sph_medium medium, sph_scalars zeta,
                                        sph_real newton, sph_vector_out acceleration)
{
    int error = sphi_check_medium(k, 3, cloud, medium, cloud.last);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_positive("omega", medium.omega, cloud.points.n);
    if (!error) error = sphi_check_field("zeta", zeta, cloud.points.n);
    if (!error) error = sphi_check_out("acceleration", 3, acceleration);
    if (!error && !sphi_finite(newton)) error = sphi_refuse("newton", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(3, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), own = sphi_at(zeta, i) / sphi_at(medium.omega, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(3, cloud.points, x_i, sphi_point(3, cloud.points, j));
            const sph_real scaled = sphi_at(zeta, j) / sphi_at(medium.omega, j);
            const sph_real b =
                -newton * sphi_at(medium.m, j) *
                sph_gravity_correction_pair(sphi_pair_kernel(k, 3, 0, x_ij, h_i, cloud.h, j), own, scaled);
            ax += b * x_ij.x;
            ay += b * x_ij.y;
            az += b * x_ij.z;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        failed += sphi_store_vector(3, acceleration, i, sum);
    }
    return failed;
}

/* ================================================================ solids
 *
 * Elastic solids in total Lagrangian form: lists, volumes, gradients and their correction belong to the
 * reference state X, and are built once. There is no tensile instability, and no neighbour search. With the
 * current positions x, grad_i W_ij = F X_ij of the reference state (F <= 0), and the correction
 *     L_i = K^-1,   K = sum_j V_j (-F_ij) X_ij X_ij^T     (sph_gradient_correction_cspm of the reference
 *     state)
 * the deformation gradient F_i, the stress P_i (first Piola-Kirchhoff) and the acceleration are
 *     F_i = 1 + sum_j V_j ((x_j - x_i) - (X_j - X_i)) (L_i grad_i W_ij)^T,
 *     P_i = P(F_i): any law of the host; two are given here,
 *     a_i = 1 / rho_i sum_j V_j (P_i L_i grad_i W_ij(h_i) + P_j L_j grad_i W_ij(h_j)),
 * where rho is the density of the reference state. F is exact for affine maps. It is the same as the usual
 * sum_j V_j (x_j - x_i) (L_i grad_i W_ij)^T, but rounds less, and is 1 where L = 0.
 *
 * What is kept, to round-off, because the same L stands in F and in the force:
 *   momentum          the forces of a pair are opposite;
 *   angular momentum  the torque on all is that of sum_i V_i P_i F_i^T, which is symmetric for every law that
 *                     does not depend on the observer. Without L_i and L_j in the force it is lost;
 *   energy            sum_i V_i P_i : dF_i/dt = -sum_i m_i a_i . v_i: what the stress takes the motion loses.
 * A checkerboard of displacements leaves F inside as it is, so that stress does not see it. Hourglass control
 * pulls every pair towards the place that F tells, with e_i = F_i X_ij - x_ij, the rest that F does not
 * explain:
 *     a_i += 1 / rho_i sum_j V_j alpha / 2 (E_i (-F_ij(h_i)) e_i + E_j (-F_ij(h_j)) e_j).
 * It is the derivative of the energy sum_ij V_i V_j alpha / 4 E_i (-F_ij(h_i)) |e_i|^2: F_i is the matrix
 * that makes this energy least, because L stands in it, so that no derivative of F appears. So energy and
 * both momenta are kept, and it is 0 for affine maps. The form of Ganzenmueller 2015, with W_ij / |X_ij|^2 in
 * the place of -F_ij and the part of e along the pair alone, keeps the momenta, but feeds energy into bodies
 * that are not damped (examples/solids/solids_torque.c: 2.6 times the energy after 2000 steps, where this
 * form keeps it).
 *
 * The order of a step: sph_deformation_gradient, the law for each particle, sph_solid_acceleration; then v,
 * then x. The longest step is about that of sph_time_step_sound with sph_sound_speed_elastic.
 *
 * Sources: Randles & Libersky 2000, IJNME 48, 1445; Vignjevic, Reveles & Campbell 2006, CMES 14, 181;
 * Ganzenmueller 2015, CMAME 286, 87 (hourglass control); Silling 2017, CMAME 322, 42 (the form with an
 * energy, in peridynamics).
 */

/* -------- solids: laws and pair functions */

/* Lame's constants: lambda, the first, and mu, the shear modulus. */
typedef struct sph_elastic {
    sph_real first, shear;
} sph_elastic;
/* lambda = E nu / ((1 + nu) (1 - 2 nu)) and mu = E / (2 (1 + nu)) from Young's modulus and Poisson's ratio.
   Two dimensions are plane strain; for plane stress take 2 lambda mu / (lambda + 2 mu) as the first constant.
   Needs young >= 0 and -1 < poisson < 1/2. */
SPH_FN sph_elastic sph_elastic_of(sph_real young, sph_real poisson)
{
    sph_elastic e;
    SPH_ASSERT(young >= SPH_R(0) && poisson > SPH_R(-1) && poisson < SPH_R(0.5));
    e.shear = SPH_R(0.5) * young / (SPH_R(1) + poisson);
    e.first = SPH_R(2) * e.shear * poisson / (SPH_R(1) - SPH_R(2) * poisson);
    return e;
}
/* The speed of longitudinal waves, sqrt((lambda + 2 mu) / rho). Needs lambda + 2 mu >= 0 and rho > 0. */
SPH_FN sph_real sph_sound_speed_elastic(sph_elastic e, sph_real rho)
{
    SPH_ASSERT(e.first + SPH_R(2) * e.shear >= SPH_R(0) && rho > SPH_R(0));
    return SPHI_SQRT((e.first + SPH_R(2) * e.shear) / rho);
}
/* The product a b. Entries beyond dim are 0. */
SPH_FN sph_mat sphi_mat_product(int dim, sph_mat a, sph_mat b)
{
    const sph_mat t = sph_mat_transposed(dim, b);
    sph_mat c; /* by columns */
    c.x = sph_mat_times(dim, a, t.x);
    c.y = sph_mat_times(dim, a, t.y);
    c.z = sph_mat_times(dim, a, t.z);
    return sph_mat_transposed(dim, c);
}
/* Saint Venant & Kirchhoff: P = F S with S = lambda tr(E) 1 + 2 mu E and E = (F^T F - 1) / 2, the derivative
   of the energy lambda / 2 tr(E)^2 + mu E : E by F. Linear in Green's strain: for large rotations and small
   strains. It is soft in compression: a body that is squeezed to less than 0.58 of its length gives way. */
SPH_FN sph_mat sph_stress_saint_venant_kirchhoff(int dim, sph_mat gradient, sph_elastic e)
{
    const sph_mat t = sph_mat_transposed(dim, gradient);
    sph_mat s = sphi_mat_product(dim, t, gradient);
    sph_real along;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    s.x.x -= SPH_R(1);
    if (dim > 1) s.y.y -= SPH_R(1);
    if (dim > 2) s.z.z -= SPH_R(1);
    along = SPH_R(0.5) * e.first * (s.x.x + s.y.y + s.z.z); /* s = 2 E */
    s.x = sph_scale(e.shear, s.x);
    s.y = sph_scale(e.shear, s.y);
    s.z = sph_scale(e.shear, s.z);
    s.x.x += along;
    if (dim > 1) s.y.y += along;
    if (dim > 2) s.z.z += along;
    return sphi_mat_product(dim, gradient, s);
}
/* Neo-Hookean: P = mu (F - F^-T) + lambda ln(J) F^-T with J = det F, the derivative of the energy
   mu / 2 (tr(F^T F) - dim - 2 ln J) + lambda / 2 (ln J)^2 by F. It resists any compression. Bonet & Wood
   2008, Nonlinear Continuum Mechanics, 6.4.3. Needs J > 0: a particle that is turned inside out has no
   stress. */
SPH_FN sph_mat sph_stress_neo_hookean(int dim, sph_mat gradient, sph_elastic e)
{
    sph_mat f = gradient, p;
    sph_real det, per;
    SPH_ASSERT(SPHI_IS_DIM(dim));
    if (dim < 3) f.x.z = f.y.z = f.z.x = f.z.y = SPH_R(0), f.z.z = SPH_R(1);
    if (dim < 2) f.x.y = f.y.x = SPH_R(0), f.y.y = SPH_R(1);
    p.x = sphi_cross(f.y, f.z); /* the cofactors: J F^-T */
    p.y = sphi_cross(f.z, f.x);
    p.z = sphi_cross(f.x, f.y);
    det = sph_dot(3, f.x, p.x);
    SPH_ASSERT(det > SPH_R(0));
    per = (e.first * SPHI_LOG(det) - e.shear) / det;
    p.x = sphi_plus(3, sph_scale(e.shear, f.x), sph_scale(per, p.x));
    p.y = sphi_plus(3, sph_scale(e.shear, f.y), sph_scale(per, p.y));
    p.z = sphi_plus(3, sph_scale(e.shear, f.z), sph_scale(per, p.z));
    return sph_mat_transposed(dim, sph_mat_transposed(dim, p)); /* without the entries beyond dim */
}

/* What j adds to the sum of F_i: -V_j F_ij (x_ij - X_ij) X_ij^T, with X_ij = x0_ij and f_ij of the reference
   state. */
SPH_FN sph_mat sph_deformation_pair(int dim, sph_real V_j, sph_vec x0_ij, sph_vec x_ij, sph_real f_ij)
{
    const sph_vec moved = sph_scale(-V_j * f_ij, sph_subtract(dim, x_ij, x0_ij));
    sph_mat a;
    a.x = sph_scale(moved.x, x0_ij);
    a.y = sph_scale(dim > 1 ? moved.y : SPH_R(0), x0_ij);
    a.z = sph_scale(dim > 2 ? moved.z : SPH_R(0), x0_ij);
    return a;
}
/* F = 1 + sum L^T of these sums. Entries beyond dim are 0. */
SPH_FN sph_mat sph_deformation_value(int dim, sph_mat sum, sph_mat inverse)
{
    sph_mat f = sphi_mat_product(dim, sum, sph_mat_transposed(dim, inverse));
    f.x.x += SPH_R(1);
    if (dim > 1) f.y.y += SPH_R(1);
    if (dim > 2) f.z.z += SPH_R(1);
    return f;
}
/* A particle of a solid: L, F, P, and Young's modulus, which scales the hourglass control. */
typedef struct sph_solid_side {
    sph_mat inverse, gradient, stress;
    sph_real modulus;
} sph_solid_side;
/* What j adds to the acceleration of i by stress: weight (P_i L_i X_ij f_i + P_j L_j X_ij f_j) with
   weight = V_j / rho_i, X_ij = x0_ij, and f_i, f_j of the reference state. gradient and modulus are not read.
   */
SPH_FN sph_vec sph_stress_pair(int dim, sph_solid_side i, sph_solid_side j, sph_real weight, sph_vec x0_ij,
                               sph_pair_kernel f)
{
    return sphi_plus(
        dim, sph_mat_times(dim, i.stress, sph_scale(weight * f.f_i, sph_mat_times(dim, i.inverse, x0_ij))),
        sph_mat_times(dim, j.stress, sph_scale(weight * f.f_j, sph_mat_times(dim, j.inverse, x0_ij))));
}
/* By hourglass control: weight / 2 (E_i (-f_i) e_i + E_j (-f_j) e_j) with e_i = F_i X_ij - x_ij, X_ij = x0_ij
   and weight = alpha V_j / rho_i (see the beginning of this chapter). A pair that is too far apart attracts.
   inverse and stress are not read. */
SPH_FN sph_vec sph_hourglass_pair(int dim, sph_solid_side i, sph_solid_side j, sph_real weight, sph_vec x0_ij,
                                  sph_vec x_ij, sph_pair_kernel f)
{
    const sph_vec e_i = sph_subtract(dim, sph_mat_times(dim, i.gradient, x0_ij), x_ij),
                  e_j = sph_subtract(dim, sph_mat_times(dim, j.gradient, x0_ij), x_ij);
    const sph_real half_weight = SPH_R(-0.5) * weight;
    return sphi_plus(dim, sph_scale(half_weight * i.modulus * f.f_i, e_i),
                     sph_scale(half_weight * j.modulus * f.f_j, e_j));
}

/* -------- solids: sweeps
   The cloud is that of the reference state. */

/* The state of a solid, one value for each particle, all sources. */
typedef struct sph_solid {
    sph_matrices inverse, stress; /* L of sph_gradient_correction_cspm, and P */
    sph_scalars density;          /* of the reference state, of the targets */
    /* For hourglass control: its coefficient alpha (0: none; 1 is usual), and what else it reads: the current
       positions, F, and Young's modulus, not negative. */
    sph_real hourglass;
    sph_points x;
    sph_matrices gradient;
    sph_scalars modulus;
} sph_solid;

/* The current positions: as many as in the cloud, with a box of their own. */
SPH_FN int sphi_check_current(int dim, sph_points x, sph_index n)
{
    int error = x.n == n ? 0 : sphi_refuse("x.n", -1, SPH_ERROR_COUNT);
    if (!error) error = sphi_check_arrays(dim, x);
    if (!error) error = sphi_check_positions(dim, x);
    return error ? error : sphi_check_box(dim, x, SPH_R(0), 0);
}

/* The deformation gradient F of the targets (see the beginning of this chapter). x: the current positions; in
   a box that repeats they have the box of their own, and pairs are those of the nearest images. inverse: L of
   the targets; where it is 0, F = 1. Exact for affine maps, also at boundaries; for other maps the error is
   O(h) there and in disorder, O(h^2) in the interior of a lattice. Where an entry overflows, the matrix is 0
   and the target counts as failed. */
SPH_FN sph_index sph_deformation_gradient(sph_kernel k, int dim, sph_cloud cloud, sph_points x,
                                          sph_matrices inverse, sph_matrix_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_current(dim, x, cloud.points.n);
    if (!error) error = sphi_check_matrices("inverse", dim, inverse, cloud.last);
    if (!error) error = sphi_check_matrix_out("out", dim, out);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x0_i = sphi_point(dim, cloud.points, i), x_i = sphi_point(dim, x, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real xx = SPH_R(0), xy = SPH_R(0), xz = SPH_R(0), yx = SPH_R(0), yy = SPH_R(0), yz = SPH_R(0),
                 zx = SPH_R(0), zy = SPH_R(0), zz = SPH_R(0);
        sph_mat sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], xx, xy, xz, yx, yy, yz, zx, zy, zz) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x0_ij = sphi_separation(dim, cloud.points, x0_i, sphi_point(dim, cloud.points, j)),
                          x_ij = sphi_separation(dim, x, x_i, sphi_point(dim, x, j));
            const sph_mat c = sph_deformation_pair(dim, sphi_at(cloud.volume, j), x0_ij, x_ij,
                                                   sph_kernel_f(k, dim, sph_length(dim, x0_ij), h_i));
            xx += c.x.x;
            if (dim > 1) {
                xy += c.x.y;
                yx += c.y.x;
                yy += c.y.y;
            }
            if (dim > 2) {
                xz += c.x.z;
                yz += c.y.z;
                zx += c.z.x;
                zy += c.z.y;
                zz += c.z.z;
            }
        }
        sum.x.x = xx, sum.x.y = xy, sum.x.z = xz;
        sum.y.x = yx, sum.y.y = yy, sum.y.z = yz;
        sum.z.x = zx, sum.z.y = zy, sum.z.z = zz;
        failed +=
            sphi_store_matrix(dim, out, i, sph_deformation_value(dim, sum, sphi_matrix_at(dim, inverse, i)));
    }
    return failed;
}

SPH_FN sph_solid_side sphi_solid_side(int dim, int controlled, const sph_solid *s, sph_index i)
{
    sph_solid_side a;
    a.inverse = sphi_matrix_at(dim, s->inverse, i);
    a.stress = sphi_matrix_at(dim, s->stress, i);
    a.gradient = controlled ? sphi_matrix_at(dim, s->gradient, i) : a.stress;
    a.modulus = controlled ? sphi_at(s->modulus, i) : SPH_R(0);
    return a;
}
SPH_FN sph_index sphi_solid_range(int controlled, int uniform, sph_kernel k, int dim, sph_cloud cloud,
                                  const sph_solid *s, sph_vector_out acceleration)
{
    sph_index i, p, failed = 0;
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x0_i = sphi_point(dim, cloud.points, i),
                      x_i = controlled ? sphi_point(dim, s->x, i) : x0_i;
        const sph_real h_i = sphi_at(cloud.h, i), per = SPH_R(1) / sphi_at(s->density, i);
        const sph_solid_side own = sphi_solid_side(dim, controlled, s, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0);
        sph_vec sum;
        SPH_SUM(p, cloud.list.start[i], cloud.list.start[i + 1], ax, ay, az) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x0_ij = sphi_separation(dim, cloud.points, x0_i, sphi_point(dim, cloud.points, j));
            const sph_real weight = per * sphi_at(cloud.volume, j);
            const sph_solid_side other = sphi_solid_side(dim, controlled, s, j);
            const sph_pair_kernel f = sphi_pair_kernel(k, dim, uniform, x0_ij, h_i, cloud.h, j);
            sph_vec c = sph_stress_pair(dim, own, other, weight, x0_ij, f);
            if (controlled) {
                const sph_vec x_ij = sphi_separation(dim, s->x, x_i, sphi_point(dim, s->x, j));
                c = sphi_plus(dim, c,
                              sph_hourglass_pair(dim, own, other, s->hourglass * weight, x0_ij, x_ij, f));
            }
            ax += c.x;
            if (dim > 1) ay += c.y;
            if (dim > 2) az += c.z;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        failed += sphi_store_vector(dim, acceleration, i, sum);
    }
    return failed;
}
/* The acceleration of the targets by stress, and by hourglass control if solid.hourglass is not 0 (see the
   beginning of this chapter). Momentum and angular momentum are kept to round-off, if stress is the law of F.
   Lists hold all pairs with r < support ratio * max(h_i, h_j) in the reference state (SPH_LARGER). A particle
   whose L is 0 exerts no stress. Returns the number of targets whose acceleration overflowed (it is 0 then),
   or a negative sph_error: SPH_ERROR_VALUE also for densities that are not positive. */
SPH_FN sph_index sph_solid_acceleration(sph_kernel k, int dim, sph_cloud cloud, sph_solid solid,
                                        sph_vector_out acceleration)
{
    const int controlled = solid.hourglass != SPH_R(0);
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_matrices("inverse", dim, solid.inverse, cloud.points.n);
    if (!error) error = sphi_check_matrices("stress", dim, solid.stress, cloud.points.n);
    if (!error) error = sphi_check_positive("density", solid.density, cloud.last);
    if (!error && !sphi_finite(solid.hourglass)) error = sphi_refuse("solid.hourglass", -1, SPH_ERROR_VALUE);
    if (!error && controlled) error = sphi_check_current(dim, solid.x, cloud.points.n);
    if (!error && controlled) error = sphi_check_matrices("gradient", dim, solid.gradient, cloud.points.n);
    if (!error && controlled) error = sphi_check_not_negative("modulus", solid.modulus, cloud.points.n);
    if (!error) error = sphi_check_out("acceleration", dim, acceleration);
    if (error) return sphi_answer_of(error);
    if (controlled)
        return cloud.h.stride ? sphi_solid_range(1, 0, k, dim, cloud, &solid, acceleration)
                              : sphi_solid_range(1, 1, k, dim, cloud, &solid, acceleration);
    return cloud.h.stride ? sphi_solid_range(0, 0, k, dim, cloud, &solid, acceleration)
                          : sphi_solid_range(0, 1, k, dim, cloud, &solid, acceleration);
}

/* ================================================================ measures of a cloud
 *
 * How the particles lie, and what they conserve. Each function has its own formula and source.
 */

/* The distance from each target to its nearest source in the list. Where the list is empty it is 0, with
   SPH_TOO_FEW. Targets and sources may be the same points, or probes and particles (lists by
   SPH_LIST_FOREIGN). In the second case the fraction of probes without a particle within some distance is
   the void fraction. The box is that of the sources. Returns the number of targets that are not SPH_OK, or
   a negative sph_error. */
SPH_FN sph_index sph_nearest_distance(int dim, sph_cloud targets_of, sph_points sources, sph_scalar_out out)
{
    const sph_index first = targets_of.first, last = targets_of.last;
    const sph_list list = targets_of.list;
    sph_points targets = targets_of.points;
    sph_index i, p, failed = 0;
    int error = sphi_check_frame(dim, targets_of);
    targets.box = sources.box;
    if (!error && sources.n < 0) error = sphi_refuse("sources.n", -1, SPH_ERROR_COUNT);
    if (!error && sources.n > 0) error = sphi_check_arrays(dim, sources);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_positions(dim, targets);
    if (!error && sources.n > 0) error = sphi_check_positions(dim, sources);
    if (!error) error = sphi_check_box(dim, targets, SPH_R(0), 0);
    if (!error) error = sphi_check_box(dim, sources, SPH_R(0), 0);
    if (!error) error = sphi_check_entries(first, last, list, sources.n, 1);
    if (error) return sphi_answer_of(error);
    for (i = first; i < last; i++) {
        const sph_vec x_i = sphi_point(dim, targets, i);
        sph_real least = SPH_R(-1);
        int state = SPH_OK;
        for (p = list.start[i]; p < list.start[i + 1]; p++) {
            const sph_real r =
                sph_length(dim, sphi_separation(dim, sources, x_i, sphi_point(dim, sources, list.index[p])));
            if (least < SPH_R(0) || r < least) least = r;
        }
        if (least < SPH_R(0)) {
            state = SPH_TOO_FEW;
            least = SPH_R(0);
        } else if (!sphi_finite(least)) {
            state = SPH_NOT_FINITE;
            least = SPH_R(0);
        }
        failed += sphi_answer(out, i, least, state);
    }
    return failed;
}

/* The hexatic order in 2D: |sum exp(6 i theta)| / 6 over the six nearest neighbours in the list. It is 1
   on a hexagonal lattice, and about 0.36 for random particles. Nelson & Halperin 1979, PRB 19, 2457. Where
   there are fewer than six neighbours (coincident ones do not count), it is 0, with SPH_TOO_FEW. Returns
   the number of targets that are not SPH_OK, or a negative sph_error. */
SPH_FN sph_index sph_hexatic_order(sph_cloud cloud, sph_scalar_out out)
{
    int error = sphi_check_list(2, cloud, SPH_R(0));
    sph_index i, p, failed = 0;
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(2, cloud.points, i);
        sph_real r2[6], re[6], im[6], a = SPH_R(0), b = SPH_R(0);
        int n = 0, c, state = SPH_OK;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_vec e =
                sphi_separation(2, cloud.points, sphi_point(2, cloud.points, cloud.list.index[p]), x_i);
            const sph_real d = sph_dot(2, e, e);
            sph_real u, v, uu;
            if (!(d > SPH_R(0)) || (n == 6 && !(d < r2[5]))) continue;
            if (n < 6) n++;
            u = e.x * e.x / d, v = e.y * e.x / d; /* cos^2 and cos sin, which give 2 theta and 6 theta */
            u = SPH_R(2) * u - SPH_R(1);
            v = SPH_R(2) * v;
            uu = u * u - SPH_R(3) * v * v;
            for (c = n - 1; c > 0 && r2[c - 1] > d; c--) {
                r2[c] = r2[c - 1];
                re[c] = re[c - 1];
                im[c] = im[c - 1];
            }
            r2[c] = d;
            re[c] = u * uu; /* cos 6 theta = cos 3 (2 theta) */
            im[c] = v * (SPH_R(3) * u * u - v * v);
        }
        for (c = 0; c < n; c++) {
            a += re[c];
            b += im[c];
        }
        a = SPHI_SQRT(a * a + b * b) / SPH_R(6);
        if (n < 6) state = SPH_TOO_FEW;
        else if (!sphi_finite(a)) state = SPH_NOT_FINITE;
        failed += sphi_answer(out, i, state ? SPH_R(0) : a, state);
    }
    return failed;
}

/* The radial distribution function: g[b] is the number of pairs with b <= r / width < b + 1, width =
   farthest / bins, divided by the number that is expected at the number_density (particles per
   length^dim). In a large cloud it is 1 far from a particle. Full lists that hold every pair with r <
   farthest. Without targets g is not changed. Returns the number of shells that are so small or large that
   g overflows (it is 0 there), or a negative sph_error. */
SPH_FN sph_index sph_radial_distribution(int dim, sph_cloud cloud, sph_real farthest, sph_real number_density,
                                         int bins, SPH_GLOBAL sph_real *g)
{
    int error, b;
    sph_index i, p, failed = 0;
    if (!sphi_finite(farthest) || !(farthest > SPH_R(0))) return sphi_refuse("farthest", -1, SPH_ERROR_H);
    if (bins < 1) return sphi_refuse("bins", -1, SPH_ERROR_COUNT);
    error = sphi_check_list(dim, cloud, farthest);
    if (!error && !g) error = sphi_refuse("g", -1, SPH_ERROR_NULL);
    if (!error && (!sphi_finite(number_density) || !(number_density > SPH_R(0))))
        error = sphi_refuse("number_density", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (b = 0; b < bins; b++) g[b] = SPH_R(0);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_real r =
                sph_length(dim, sphi_separation(dim, cloud.points, x_i,
                                                sphi_point(dim, cloud.points, cloud.list.index[p])));
            if (r < farthest) {
                const int at = (int)(r / farthest * (sph_real)bins);
                g[at < 0 ? 0 : at < bins ? at : bins - 1] += SPH_R(1);
            }
        }
    }
    for (b = 0; b < bins; b++) {
        const sph_real width = farthest / (sph_real)bins, in = width * (sph_real)b, out = in + width;
        const sph_real volume = dim == 1   ? SPH_R(2) * (out - in)
                                : dim == 2 ? SPH_R(3.14159265358979323846) * (out * out - in * in)
                                           : SPH_R(4.18879020478639098462) * (out * out * out - in * in * in);
        failed += sphi_put(g, 1, b, g[b] / ((sph_real)(cloud.last - cloud.first) * number_density * volume));
    }
    return failed;
}

/* The number of targets that have another source within `distance`. With 1e-12 h these are the particles
   that exert no force on each other. Returns this number, or a negative sph_error. */
SPH_FN sph_index sph_coincident_count(int dim, sph_cloud cloud, sph_real distance)
{
    sph_index i, p, found = 0;
    int error;
    if (!sphi_finite(distance) || distance < SPH_R(0)) return sphi_refuse("distance", -1, SPH_ERROR_H);
    error = sphi_check_list(dim, cloud, distance);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        int near_by = 0;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++)
            near_by |=
                !(sph_length(dim, sphi_separation(dim, cloud.points, x_i,
                                                  sphi_point(dim, cloud.points, cloud.list.index[p]))) >
                  distance);
        found += near_by;
    }
    return found;
}
/* Separates targets from the sources that they coincide with, within the distance `within`: neither
   forces, nor kernels, nor collisions do so, because such a pair has no direction. A target that coincides
   with another moves by `distance` in a direction that depends on its index only: in 2D and 3D by the golden
   angle, so that close indices get different directions; in 1D to the left if its index is even, else to the
   right, so that two of the same parity stay together. The new positions of all targets are written; those
   that coincide with none keep theirs. The host wraps and stores them. Returns the number of targets that
   coincide, or a negative sph_error. */
SPH_FN sph_index sph_coincident_separate(int dim, sph_cloud cloud, sph_real within, sph_real distance,
                                         sph_vector_out position)
{
    sph_index i, moved = 0;
    int error;
    if (!sphi_finite(within) || within < SPH_R(0) || !sphi_finite(distance))
        return sphi_refuse("within, distance", -1, SPH_ERROR_H);
    error = sphi_check_list(dim, cloud, within);
    if (!error) error = sphi_check_out("position", dim, position);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec was = sphi_point(dim, cloud.points, i);
        sph_vec at = was;
        sph_index p;
        int coincides = 0;
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++)
            coincides |=
                !(sph_length(dim, sphi_separation(dim, cloud.points, at,
                                                  sphi_point(dim, cloud.points, cloud.list.index[p]))) >
                  within);
        if (coincides) {
            const sph_real turn = SPH_R(2.39996322972865332) * (sph_real)(i % 100003),
                           up = SPH_R(i % 7 - 3) / SPH_R(4),
                           flat = dim > 2 ? SPHI_SQRT(SPH_R(1) - up * up) : SPH_R(1);
            if (dim == 1) at.x += i % 2 ? distance : -distance;
            else {
                at.x += distance * flat * SPHI_COS(turn);
                at.y += distance * flat * SPHI_SIN(turn);
                if (dim > 2) at.z += distance * up;
            }
            if (!sphi_finite(at.x) || !sphi_finite(at.y) || !sphi_finite(at.z))
                at = was; /* the new position would overflow */
            moved++;
        }
        sphi_store_vector(dim, position, i, at);
    }
    return moved;
}

/* Mass, momentum, angular momentum about the origin and kinetic energy of the targets. */
typedef struct sph_conserved {
    sph_real mass, kinetic_energy;
    sph_vec momentum, angular_momentum; /* of the second, only z is not 0 in 2D, and none in 1D */
} sph_conserved;
/* Adds with compensated rounding (Kahan), because changes of conserved sums show in the last digits. */
SPH_FN void sphi_add_compensated(sph_real *sum, sph_real *lost, sph_real value)
{
    const sph_real a = value - *lost, b = *sum + a;
    *lost = (b - *sum) - a;
    *sum = b;
}
/* Mass, momentum, angular momentum and kinetic energy of the targets first ... last - 1. x and v are taken
   as they are: the angular momentum has a meaning only if the positions of a periodic box were never
   wrapped. Returns 0; or 1 if a sum overflowed (all sums are 0 then); or a negative sph_error. */
SPH_FN sph_index sph_conserved_sums(int dim, sph_cloud cloud, sph_scalars m, sph_vectors v,
                                    sph_conserved *out)
{
    const sph_points x = cloud.points;
    sph_real sum[8], lost[8];
    sph_index i;
    int c, ok = 1, error = out ? sphi_check_targets(dim, cloud) : sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_arrays(dim, x);
    if (!error && cloud.checked != 1) error = sphi_check_positions(dim, x);
    if (!error) error = sphi_check_field("m", m, cloud.last);
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.last);
    if (error < 0) return error;
    for (c = 0; c < 8; c++) sum[c] = lost[c] = SPH_R(0);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec r = sphi_point(dim, x, i), u = sphi_vector_at(dim, v, i), turn = sphi_cross(r, u);
        const sph_real m_i = sphi_at(m, i);
        sph_real term[8];
        term[0] = m_i;
        term[1] = SPH_R(0.5) * m_i * sph_dot(dim, u, u);
        term[2] = m_i * u.x;
        term[3] = m_i * u.y;
        term[4] = m_i * u.z;
        term[5] = m_i * turn.x;
        term[6] = m_i * turn.y;
        term[7] = m_i * turn.z;
        for (c = 0; c < 8; c++) sphi_add_compensated(&sum[c], &lost[c], term[c]);
    }
    for (c = 0; c < 8; c++) ok = ok && sphi_finite(sum[c]);
    for (c = 0; c < 8 && !ok; c++) sum[c] = SPH_R(0);
    out->mass = sum[0];
    out->kinetic_energy = sum[1];
    out->momentum.x = sum[2];
    out->momentum.y = sum[3];
    out->momentum.z = sum[4];
    out->angular_momentum.x = sum[5];
    out->angular_momentum.y = sum[6];
    out->angular_momentum.z = sum[7];
    return !ok;
}

/* ================================================================ likely mistakes
 *
 * Some mistakes pass every check of a sweep: it answers 0, but its numbers are meaningless.
 * sph_cloud_examine looks for such mistakes. Call it once on a new cloud, and always in a test suite:
 *
 *     sph_findings found;
 *     if (sph_cloud_examine(SPH_WENDLAND_C2, 3, cloud, 0, 0, &found) > 0)
 *         for (i = 0; i < SPH_FINDING_COUNT; i++)
 *             if (found.set & (1u << i))
 *                 printf("particle %d: %s\n", (int)found.at[i].particle, sph_finding_text(i));
 */

/* -------- likely mistakes: types */

/* What may be wrong. sph_finding_text explains each in words. */
typedef enum sph_finding {
    SPH_FINDING_LIST_SHORT,     /* every row ends before the support does */
    SPH_FINDING_LIST_SUPPORT,   /* every row ends at h: h and the support are mixed up */
    SPH_FINDING_LIST_HALF,      /* each pair is in one of its two rows only */
    SPH_FINDING_LIST_ONE_SIDED, /* pairs are missing that are inside the support of one particle only */
    SPH_FINDING_LIST_STALE,     /* rows lack particles that are nearer than others they hold: an old list */
    SPH_FINDING_LIST_FROM_ONE,  /* indices or starts count from 1 */
    SPH_FINDING_BOX,            /* positions and list do not have the same periodic box */
    SPH_FINDING_VOLUME_ZERO,    /* a volume is negative, or more than half of them are 0 */
    SPH_FINDING_VOLUME_SUM,     /* sum_j V_j W_ij in the interior is far from 1: perhaps masses were given */
    SPH_FINDING_DIM_HIGH,       /* a coordinate is the same for all particles: dim is too high */
    SPH_FINDING_DIM_LOW,        /* particles differ in a coordinate beyond dim: dim is too low */
    SPH_FINDING_STRIDE,         /* the stride of positions is in bytes, or two components share memory */
    SPH_FINDING_COUNT
} sph_finding;

/* The first place where a mistake shows: a particle, a neighbour (-1: none), and a number, `ratio`:
     LIST_*, BOX    distance / support, with the support that decides for this pair
     LIST_FROM_ONE  0; neighbour is the entry as it is in the list
     VOLUME_ZERO    the volume
     VOLUME_SUM     the sum
     DIM_HIGH       0
     DIM_LOW        the difference of the coordinates of the two particles / support
     STRIDE         if two components share memory, the distance of their pointers in sph_real;
                    else the given stride / the likely stride */
typedef struct sph_offender {
    sph_index particle, neighbour;
    sph_real ratio;
    SPHI_TCC_PAD
} sph_offender;

/* All findings. */
typedef struct sph_findings {
    unsigned set;                       /* has the bit 1u << finding for each finding */
    sph_offender at[SPH_FINDING_COUNT]; /* particle = -1 where there is no finding */
    sph_index sampled;                  /* number of targets that were compared with all particles */
    sph_index interior;                 /* how many of them have particles on all sides; 0 without volumes */
    /* The least and the largest sum_j V_j W_ij of the latter: near 1 in a healthy cloud, and 0
       if interior is 0. */
    sph_real sum_lowest, sum_highest;
} sph_findings;

/* -------- likely mistakes: functions */

/* What is examined: the cloud as it is, or as it would be if a guess were right. */
typedef struct sphi_case {
    sph_cloud cloud;
    sph_vec extent;                    /* of all positions */
    sph_real support_ratio, largest;   /* support / h, and the largest support */
    sph_index start_base, index_base;  /* 0 or 1, the number that the list counts from */
    int dim, both_sides, with_volumes; /* with_volumes: also compute the sums */
} sphi_case;

/* What the sampled rows show. */
typedef struct sphi_tally {
    /* Numbers of rows, of pairs that are needed, and of entries: all that are listed, those that are no
       particle, those that are the particle itself. */
    size_t rows, needed, listed, outside, self;
    /* Numbers of pairs that are missing: all, through the box, beyond the smaller of both supports. */
    size_t missing, missing_across, missing_between;
    /* Numbers of pairs of two targets that need each other: in both rows, in one, in none. */
    size_t pairs_both, pairs_one, pairs_none;
    /* Numbers of rows with a particle that is too far away, and of targets with particles on all sides. */
    size_t wide, interior;
    int ends_by_distance, ends_by_ratio;    /* 1: each row holds all that is nearer, none that is farther */
    sph_real own_listed, own_missing;       /* r / h_i: the largest listed, the smallest missing */
    sph_real larger_listed, larger_missing; /* r / max(h_i, h_j) */
    sph_real sum_lowest, sum_highest;       /* sum_j V_j W_ij */
    /* The first particle that lacks a neighbour, the first with one too far away, and the extreme sums. */
    sph_offender lacking, distant, sum_low, sum_high;
} sphi_tally;

/* Distances within 1e-3 of a radius count as on either side of it, because of rounding, and of lattices
   that have a shell there. */
#define SPHI_SLACK SPH_R(1e-3)

SPH_FN sph_offender sphi_offender(sph_index particle, sph_index neighbour, sph_real ratio)
{
    sph_offender o;
    o.particle = particle;
    o.neighbour = neighbour;
    o.ratio = ratio;
    return o;
}
SPH_FN void sphi_find(sph_findings *f, int finding, sph_offender where)
{
    f->set |= 1u << finding;
    f->at[finding] = where;
}
/* 1 if the row of target i holds j. */
SPH_FN int sphi_row_holds(const sphi_case *c, sph_index i, sph_index j)
{
    const sph_list list = c->cloud.list;
    const sph_index end = list.start[i + 1] - c->start_base;
    sph_index p;
    for (p = list.start[i] - c->start_base; p < end; p++)
        if (list.index[p] - c->index_base == j) return 1;
    return 0;
}
/* A pair: the vector d from i to j between nearest images, r = |d|, and q = r / the larger
   of both supports. */
typedef struct sphi_measure {
    sph_vec d;
    sph_real r, q, own, other; /* own, other: the supports of i and j */
    int across;                /* 1: through the periodic box */
} sphi_measure;
SPH_FN sphi_measure sphi_measure_pair(const sphi_case *c, sph_index i, sph_index j)
{
    const sph_vec a = sphi_point(c->dim, c->cloud.points, i), b = sphi_point(c->dim, c->cloud.points, j);
    const sph_vec plain = sph_subtract(c->dim, b, a);
    sphi_measure s;
    s.d = sphi_separation(c->dim, c->cloud.points, b, a);
    s.across = SPHI_ABS(plain.x - s.d.x) > SPH_R(0);
    if (c->dim > 1) s.across |= SPHI_ABS(plain.y - s.d.y) > SPH_R(0);
    if (c->dim > 2) s.across |= SPHI_ABS(plain.z - s.d.z) > SPH_R(0);
    s.r = sph_length(c->dim, s.d);
    s.own = c->support_ratio * sphi_at(c->cloud.h, i);
    s.other = c->support_ratio * sphi_at(c->cloud.h, j);
    s.q = s.r / (s.own > s.other ? s.own : s.other);
    return s;
}
/* The radius within which the row of i must hold j, less the slack. */
SPH_FN sph_real sphi_reach_own(const sphi_case *c, sphi_measure s)
{
    return (SPH_R(1) - SPHI_SLACK) * (c->both_sides && s.other > s.own ? s.other : s.own);
}
/* The radius within which the row of j must hold i, less the slack. */
SPH_FN sph_real sphi_reach_other(const sphi_case *c, sphi_measure s)
{
    return (SPH_R(1) - SPHI_SLACK) * (c->both_sides && s.own > s.other ? s.own : s.other);
}
/* Counts that the row of i lacks j; own is the support of i, reach the radius within which it needs j. */
SPH_FN void sphi_tally_missing(const sphi_case *c, sphi_tally *t, sph_index i, sph_index j, sphi_measure s,
                               sph_real own, sph_real reach)
{
    const sph_real by_own = c->support_ratio * s.r / own, by_larger = c->support_ratio * s.q;
    if (!t->missing) t->lacking = sphi_offender(i, j, s.r * (SPH_R(1) - SPHI_SLACK) / reach);
    if (!t->missing || by_own < t->own_missing) t->own_missing = by_own;
    if (!t->missing || by_larger < t->larger_missing) t->larger_missing = by_larger;
    t->missing++;
    t->missing_across += s.across ? 1u : 0u;
    t->missing_between += s.r > (SPH_R(1) - SPHI_SLACK) * (s.own < s.other ? s.own : s.other) ? 1u : 0u;
}
SPH_FN void sphi_tally_zero(sphi_tally *t)
{
    t->rows = t->needed = t->listed = t->outside = t->self = 0;
    t->missing = t->missing_across = t->missing_between = 0;
    t->pairs_both = t->pairs_one = t->pairs_none = 0;
    t->wide = t->interior = 0;
    t->ends_by_distance = t->ends_by_ratio = 1;
    t->own_listed = t->own_missing = t->larger_listed = t->larger_missing = SPH_R(0);
    t->sum_lowest = t->sum_highest = SPH_R(0);
    t->lacking = t->distant = t->sum_low = t->sum_high = sphi_offender(-1, -1, SPH_R(0));
}
/* 1 if the particle has others on all sides. offset, distances and m are the sums of the vectors to them,
   of their lengths, and of their products. */
SPH_FN int sphi_surrounded(int dim, sph_vec offset, sph_real distances, sph_sym m)
{
    sph_real trace = m.xx, det = m.xx;
    if (!(distances > SPH_R(0)) ||
        sph_length(dim, offset) > (dim == 1 ? SPH_R(0.25) : SPH_R(0.15)) * distances)
        return 0;
    if (dim == 2) {
        trace = SPH_R(0.5) * (m.xx + m.yy);
        det = m.xx * m.yy - m.xy * m.xy;
    } else if (dim == 3) {
        trace = SPH_R(1) / SPH_R(3) * (m.xx + m.yy + m.zz);
        det = m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.xz) +
              m.xz * (m.xy * m.yz - m.yy * m.xz);
    }
    return det > SPH_R(0.3) * sphi_power(trace, dim);
}

/* Compares the row of target i with all particles. The cost is n + (neighbours)^2. */
SPH_FN void sphi_tally_target(sph_kernel k, const sphi_case *c, sph_index i, sphi_tally *t)
{
    const sph_list list = c->cloud.list;
    const sph_index n = c->cloud.points.n, begin = list.start[i] - c->start_base,
                    end = list.start[i + 1] - c->start_base;
    const sph_real h_i = sphi_at(c->cloud.h, i);
    sph_real farthest_r = SPH_R(0), farthest_q = SPH_R(0), limit_r, limit_q;
    sph_real nearest_r = SPH_R(-1), nearest_q = SPH_R(-1), distances = SPH_R(0), sum = SPH_R(0);
    sph_index farthest = -1, j, p;
    long holes_r = 0, holes_q = 0;
    sph_vec offset, reach;
    sph_sym m;
    offset.x = offset.y = offset.z = reach.x = reach.y = reach.z = SPH_R(0);
    m.xx = m.xy = m.yy = m.xz = m.yz = m.zz = SPH_R(0);
    t->rows++;
    for (p = begin; p < end; p++) {
        sphi_measure s;
        sph_real by_own;
        j = list.index[p] - c->index_base;
        if (j < 0 || j >= n || j == i) {
            if (j == i) t->self++;
            else t->outside++;
            continue;
        }
        s = sphi_measure_pair(c, i, j);
        by_own = c->support_ratio * s.r / s.own;
        t->listed++;
        if (by_own > t->own_listed) t->own_listed = by_own;
        if (c->support_ratio * s.q > t->larger_listed) t->larger_listed = c->support_ratio * s.q;
        if (s.r > farthest_r) {
            farthest_r = s.r;
            farthest = j;
            reach = s.d;
        }
        if (s.q > farthest_q) farthest_q = s.q;
    }
    /* A hole: a particle that is not listed, but much nearer than one that is. The factor is not 1.5, because
       there are pairs of lattices with this ratio. */
    limit_r = farthest_r / SPH_R(1.53);
    limit_q = farthest_q / SPH_R(1.53);
    for (p = begin; p < end; p++) {
        sphi_measure s;
        j = list.index[p] - c->index_base;
        if (j < 0 || j >= n || j == i) continue;
        s = sphi_measure_pair(c, i, j);
        if (s.r < sphi_reach_own(c, s)) continue;
        holes_r -= s.r < limit_r;
        holes_q -= s.q < limit_q;
    }
    for (j = 0; j < n; j++) {
        const sphi_measure s = sphi_measure_pair(c, i, j);
        const int by_i = s.r < sphi_reach_own(c, s),
                  by_j = s.r < sphi_reach_other(c, s) && j >= c->cloud.first && j < c->cloud.last;
        int in_i = 0, in_j = 0;
        if (j == i) continue;
        if (by_i) {
            t->needed++;
            in_i = sphi_row_holds(c, i, j);
            if (!in_i) {
                sphi_tally_missing(c, t, i, j, s, s.own, sphi_reach_own(c, s));
                if (nearest_r < SPH_R(0) || s.r < nearest_r) nearest_r = s.r;
                if (nearest_q < SPH_R(0) || s.q < nearest_q) nearest_q = s.q;
            }
        } else {
            holes_r += s.r < limit_r;
            holes_q += s.q < limit_q;
        }
        if (by_j) {
            in_j = sphi_row_holds(c, j, i);
            if (!in_j) sphi_tally_missing(c, t, j, i, s, s.other, sphi_reach_other(c, s));
        }
        if (by_i && by_j) {
            t->pairs_both += in_i && in_j ? 1u : 0u;
            t->pairs_one += in_i != in_j ? 1u : 0u;
            t->pairs_none += !in_i && !in_j ? 1u : 0u;
        }
        if (c->with_volumes && s.r < s.own && sphi_at(c->cloud.volume, j) > SPH_R(0)) {
            sum += sphi_at(c->cloud.volume, j) * sph_kernel_w(k, c->dim, s.r, h_i);
            distances += s.r;
            offset.x += s.d.x;
            m.xx += s.d.x * s.d.x;
            if (c->dim > 1) {
                offset.y += s.d.y;
                m.xy += s.d.x * s.d.y;
                m.yy += s.d.y * s.d.y;
            }
            if (c->dim > 2) {
                offset.z += s.d.z;
                m.xz += s.d.x * s.d.z;
                m.yz += s.d.y * s.d.z;
                m.zz += s.d.z * s.d.z;
            }
        }
    }
    if (nearest_r >= SPH_R(0)) {
        if (farthest_r > nearest_r * (SPH_R(1) + SPHI_SLACK)) t->ends_by_distance = 0;
        if (farthest_q > nearest_q * (SPH_R(1) + SPHI_SLACK)) t->ends_by_ratio = 0;
    }
    if (holes_r > 0 && holes_q > 0 && farthest_r > SPH_R(1.25) * c->largest) {
        const int wide = SPHI_ABS(reach.x) > SPH_R(0.5) * c->extent.x ||
                         (c->dim > 1 && SPHI_ABS(reach.y) > SPH_R(0.5) * c->extent.y) ||
                         (c->dim > 2 && SPHI_ABS(reach.z) > SPH_R(0.5) * c->extent.z);
        if (wide && !t->wide++) t->distant = sphi_offender(i, farthest, sphi_measure_pair(c, i, farthest).q);
    }
    if (c->with_volumes && sphi_surrounded(c->dim, offset, distances, m)) {
        sum += sphi_at(c->cloud.volume, i) * sph_kernel_w(k, c->dim, SPH_R(0), h_i);
        if (!t->interior || sum < t->sum_lowest) {
            t->sum_lowest = sum;
            t->sum_low = sphi_offender(i, -1, sum);
        }
        if (!t->interior || sum > t->sum_highest) {
            t->sum_highest = sum;
            t->sum_high = sphi_offender(i, -1, sum);
        }
        t->interior++;
    }
}

/* Examines `samples` targets (1 to the length of the range), one in each of as many equal parts of the
   range, and up to 8 extreme ones. The place within a part varies, because all of them could else belong
   to one column of a lattice. */
SPH_FN void sphi_tally_rows(sph_kernel k, const sphi_case *c, sph_index samples, const sph_index *extra,
                            sphi_tally *t)
{
    const sph_index count = c->cloud.last - c->cloud.first, step = count / samples, rest = count % samples;
    sph_index i = c->cloud.first, s, carry = 0;
    sph_real place = SPH_R(0);
    sphi_tally_zero(t);
    for (s = 0; s < samples; s++) {
        const sph_index within = (sph_index)(place * SPH_R(step));
        sphi_tally_target(k, c, i + (within < step ? within : 0), t);
        place += SPH_R(0.618033988749894848);
        if (place >= SPH_R(1)) place -= SPH_R(1);
        i += step;
        carry += rest;
        if (carry >= samples) {
            carry -= samples;
            i++;
        }
    }
    for (s = 0; s < 8 && samples < count; s++)
        if (extra[s] >= 0) sphi_tally_target(k, c, extra[s], t);
}

/* The lengths of all pairs of the list, r and q = r / the larger support. Pairs through the periodic box
   are separated from the others. */
typedef struct sphi_lengths {
    size_t inside, across;                           /* numbers of pairs */
    sph_real inside_r, inside_q, across_r, across_q; /* the largest r and q */
    sph_real inside_lowest, across_lowest;           /* the smallest q */
    sph_offender across_longest, across_shortest;
} sphi_lengths;
SPH_FN sphi_lengths sphi_list_lengths(const sphi_case *c)
{
    const sph_list list = c->cloud.list;
    sphi_lengths v;
    sph_index i, p;
    v.inside = v.across = 0;
    v.inside_r = v.inside_q = v.across_r = v.across_q = v.inside_lowest = v.across_lowest = SPH_R(0);
    v.across_longest = v.across_shortest = sphi_offender(-1, -1, SPH_R(0));
    for (i = c->cloud.first; i < c->cloud.last; i++)
        for (p = list.start[i]; p < list.start[i + 1]; p++) {
            const sph_index j = list.index[p];
            sphi_measure s;
            if (j < 0 || j >= c->cloud.points.n || j == i) continue;
            s = sphi_measure_pair(c, i, j);
            if (s.across) {
                if (s.r > v.across_r) v.across_r = s.r;
                if (s.q > v.across_q) v.across_longest = sphi_offender(i, j, v.across_q = s.q);
                if (!v.across++ || s.q < v.across_lowest)
                    v.across_shortest = sphi_offender(i, j, v.across_lowest = s.q);
            } else {
                if (s.r > v.inside_r) v.inside_r = s.r;
                if (s.q > v.inside_q) v.inside_q = s.q;
                if (!v.inside++ || s.q < v.inside_lowest) v.inside_lowest = s.q;
            }
        }
    return v;
}

/* Pointers to two components of n particles: 1 if the components share memory, so that one component of a
   particle is the other component of some particle. *apart is the distance of the pointers in sph_real. */
SPH_FN int sphi_same_memory(const SPH_GLOBAL sph_real *a, const SPH_GLOBAL sph_real *b, size_t stride,
                            sph_index n, sph_real *apart)
{
    const size_t p = (size_t)a, q = (size_t)b, width = stride * sizeof(sph_real),
                 bytes = p > q ? p - q : q - p;
    *apart = SPH_R(bytes / sizeof(sph_real));
    return bytes % width == 0 && bytes / width < (size_t)n;
}
/* The first particle that differs from particle 0 in a component that dim does not read, or -1. */
SPH_FN sph_index sphi_differs(sph_points x, const SPH_GLOBAL sph_real *component, sph_real tolerance)
{
    sph_real apart;
    sph_index i;
    if (!component || sphi_same_memory(x.x, component, x.stride, x.n, &apart)) return -1;
    for (i = 1; i < x.n; i++) {
        const sph_real d = component[(size_t)i * x.stride] - component[0];
        if (sphi_finite(d) && SPHI_ABS(d) > tolerance) return i;
    }
    return -1;
}
/* The smallest and largest value of a component over all particles. extra[0] and extra[1] become the
   targets where it is smallest and largest. Returns 0 if a value is not finite, else 1. */
SPH_FN int sphi_extremes(sph_cloud c, const SPH_GLOBAL sph_real *x, sph_real *lowest, sph_real *highest,
                         sph_index *extra)
{
    sph_index i;
    *lowest = *highest = x[0];
    for (i = 0; i < c.points.n; i++) {
        const sph_real value = x[(size_t)i * c.points.stride];
        if (!sphi_finite(SPH_R(2) * value)) return 0;
        if (value < *lowest) *lowest = value;
        if (value > *highest) *highest = value;
        if (i < c.first || i >= c.last) continue;
        if (extra[0] < 0 || value < x[(size_t)extra[0] * c.points.stride]) extra[0] = i;
        if (extra[1] < 0 || value > x[(size_t)extra[1] * c.points.stride]) extra[1] = i;
    }
    return 1;
}

/* What the rows say about list and box. It makes at most one finding, the one that explains all
   that is missing. */
SPH_FN void sphi_judge_list(const sphi_case *c, const sphi_tally *t, sph_findings *f)
{
    const sph_real low = SPH_R(1) - SPHI_SLACK, high = SPH_R(1) + SPHI_SLACK;
    const sphi_lengths v = sphi_list_lengths(c);
    if (!t->missing) {
        /* A box with a wrong length: pairs through it are longer than all others, or they are the only
           ones that coincide. */
        const sph_real longest_r = v.inside_r > c->largest ? v.inside_r : c->largest,
                       longest_q = v.inside_q > SPH_R(1) ? v.inside_q : SPH_R(1);
        if (t->wide) sphi_find(f, SPH_FINDING_BOX, t->distant);
        else if (v.inside >= 8 && v.across_q > SPH_R(1.05) * longest_q &&
                 v.across_r > SPH_R(1.05) * longest_r)
            sphi_find(f, SPH_FINDING_BOX, v.across_longest);
        else if (v.inside >= 8 && v.across && v.across_lowest < SPHI_SLACK &&
                 v.inside_lowest > SPH_R(100) * SPHI_SLACK)
            sphi_find(f, SPH_FINDING_BOX, v.across_shortest);
    } else if (t->missing_across == t->missing && c->support_ratio * v.inside_q > low * t->larger_missing) {
        sphi_find(f, SPH_FINDING_BOX, t->lacking); /* pairs inside are listed as far as that, or farther */
    } else if (t->missing_between == t->missing) {
        sphi_find(f, SPH_FINDING_LIST_ONE_SIDED, t->lacking);
    } else if (t->pairs_one && !t->pairs_both && !t->pairs_none) {
        sphi_find(f, SPH_FINDING_LIST_HALF, t->lacking);
    } else if (t->ends_by_distance || t->ends_by_ratio) {
        const int by_own = t->own_listed <= high && t->own_missing >= low,
                  by_larger = t->larger_listed <= high && t->larger_missing >= low;
        sphi_find(f, t->listed && (by_own || by_larger) ? SPH_FINDING_LIST_SUPPORT : SPH_FINDING_LIST_SHORT,
                  t->lacking);
    } else {
        sphi_find(f, SPH_FINDING_LIST_STALE, t->lacking);
    }
}

/* Looks for the likely mistakes in a cloud (enum sph_finding). For each kind it reports the first particle
   and neighbour that show it.
     both_sides  0: the operator needs all r < support ratio * h_i (SPH_GATHER). 1: it sums over pairs, and
                 needs all r < support ratio * max(h_i, h_j) (SPH_LARGER).
     samples     how many targets are compared with all particles; <= 0 means 16. Up to 8 targets with
                 extreme coordinates and h are added.
     volume      not examined if it is sph_scalars_none(). A volume of 0 belongs to a probe, but more than
                 half of all particles cannot be probes.
     y, z        beyond dim they are read here (and nowhere else) if they are not null, to find a dim
                 that is too low.
   It is assumed that arrays are as long as n and the strides say, and list.index as long as the starts say
   (one less if these count from 1).
   Returns the number of findings (0 for a healthy or an empty cloud), or a negative sph_error, and then
   nothing was written. What a sweep would refuse is such an error, but a finding that explains it comes
   first: LIST_FROM_ONE instead of SPH_ERROR_LIST or SPH_ERROR_SELF. Findings that only follow from another
   are left out: correct what was found, and call it again.
   Cost: (samples + 8) * (n + neighbours^2), up to 4 times that where something is wrong, and one or two
   passes over the list. SPH_CHECK makes no difference.
   It does not see: what no sampled target sees; masses instead of volumes where densities are within 0.67
   ... 1.5; a too large h with volumes and a list that fit it; most boxes whose length is wrong by less
   than a spacing; starts that count from 1 in a range that does not begin at 0 (the last entry of its last
   row is then read one place too far). */
SPH_FN sph_index sph_cloud_examine(sph_kernel k, int dim, sph_cloud cloud, int both_sides, sph_index samples,
                                   sph_findings *out)
{
    const sph_points x = cloud.points;
    const sph_list list = cloud.list;
    sph_index i, p, shortest = 0, outside = 0, self = 0, entry_lowest = 0, entry_highest = -1, found = 0,
                    extra[8];
    sph_index unset = 0, negative = -1, first_unset = -1;
    sph_vec low, high;
    sph_real apart = SPH_R(0), lowest_h, flat;
    sphi_case given;
    sphi_tally tally;
    sph_findings f;
    int error, axis, geometry = 1, trial, cause = 0;

    if (dim < 1 || dim > 3) return sphi_refuse("dim", -1, SPH_ERROR_DIM);
    if (sphi_check_kernel(k)) return SPH_ERROR_KERNEL;
    if (!out) return sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (both_sides != 0 && both_sides != 1) return sphi_refuse("both_sides", -1, SPH_ERROR_VALUE);
    cloud.checked = 0;
    error = sphi_check_targets(dim, cloud);
    if (error < 0) return error;
    f.set = 0;
    f.sampled = f.interior = 0;
    f.sum_lowest = f.sum_highest = SPH_R(0);
    for (axis = 0; axis < SPH_FINDING_COUNT; axis++) f.at[axis] = sphi_offender(-1, -1, SPH_R(0));
    if (x.n == 0) {
        *out = f;
        return 0;
    }
    error = sphi_check_arrays(dim, x);
    if (error) return error;
    if (!list.start) return sphi_refuse("list", -1, SPH_ERROR_NULL);
    if (!cloud.h.p) return sphi_refuse("h", -1, SPH_ERROR_NULL);

    /* The numbers: positions, h, volumes. */
    for (i = 0; i < 8; i++) extra[i] = -1;
    low.x = low.y = low.z = high.x = high.y = high.z = SPH_R(0);
    if (!sphi_extremes(cloud, x.x, &low.x, &high.x, extra)) return sphi_refuse("x", -1, SPH_ERROR_POSITION);
    if (dim > 1 && !sphi_extremes(cloud, x.y, &low.y, &high.y, extra + 2))
        return sphi_refuse("y", -1, SPH_ERROR_POSITION);
    if (dim > 2 && !sphi_extremes(cloud, x.z, &low.z, &high.z, extra + 4))
        return sphi_refuse("z", -1, SPH_ERROR_POSITION);
    given.largest = lowest_h = sphi_at(cloud.h, 0);
    for (i = 0; i < (cloud.h.stride ? x.n : 1); i++) {
        const sph_real h_i = sphi_at(cloud.h, i);
        if (!sphi_finite(h_i) || !(h_i > SPH_R(0))) return sphi_refuse("h", i, SPH_ERROR_H);
        if (h_i > given.largest) given.largest = h_i;
        if (h_i < lowest_h) lowest_h = h_i;
        if (i < cloud.first || i >= cloud.last) continue;
        if (extra[6] < 0 || h_i < sphi_at(cloud.h, extra[6])) extra[6] = i;
        if (extra[7] < 0 || h_i > sphi_at(cloud.h, extra[7])) extra[7] = i;
    }
    given.support_ratio = sph_kernel_support_ratio(k);
    given.largest *= given.support_ratio;
    for (axis = 0; axis < dim; axis++) {
        const sph_real length = axis == 0 ? x.box.x : axis == 1 ? x.box.y : x.box.z;
        const sph_real one = axis == 0   ? low.x
                             : axis == 1 ? low.y
                                         : low.z,
                       two = axis == 0   ? high.x
                             : axis == 1 ? high.y
                                         : high.z;
        if (!sphi_finite(length) || length < SPH_R(0)) return sphi_refuse("box", -1, SPH_ERROR_BOX);
        if (!(length > SPH_R(0))) continue;
        if (!sphi_finite(SPH_R(1) / length) || SPHI_ABS(one) > SPH_R(1048576) * length ||
            SPHI_ABS(two) > SPH_R(1048576) * length)
            return sphi_refuse("box", -1, SPH_ERROR_BOX);
        if (!(given.largest <= SPH_R(0.5) * length * (SPH_R(1) + SPH_R(4) * SPH_EPSILON)))
            error = SPH_ERROR_BOX;
    }
    given.with_volumes = cloud.volume.p != 0;
    if (given.with_volumes) {
        const sph_index count = cloud.volume.stride ? x.n : 1;
        for (i = 0; i < count; i++) {
            const sph_real volume = sphi_at(cloud.volume, i);
            if (!sphi_finite(volume)) return sphi_refuse("volume", i, SPH_ERROR_VALUE);
            if (volume < SPH_R(0) && negative < 0) negative = i;
            if (volume > SPH_R(0)) continue;
            if (first_unset < 0) first_unset = i;
            unset++;
        }
        if (negative >= 0)
            sphi_find(&f, SPH_FINDING_VOLUME_ZERO,
                      sphi_offender(negative, -1, sphi_at(cloud.volume, negative)));
        else if (unset > count / 2)
            sphi_find(&f, SPH_FINDING_VOLUME_ZERO, sphi_offender(first_unset, -1, SPH_R(0)));
        if (f.set) given.with_volumes = 0;
    }

    /* The list: do starts ascend, and are entries particles? */
    given.start_base = given.index_base = 0;
    if (cloud.first < cloud.last) {
        if (cloud.first == 0 && list.start[0] == 1) given.start_base = 1;
        shortest = list.start[cloud.first] - given.start_base;
        if (shortest < 0) return sphi_refuse("list", cloud.first, SPH_ERROR_LIST);
        for (i = cloud.first; i < cloud.last; i++)
            if (list.start[i + 1] < list.start[i]) return sphi_refuse("list", i, SPH_ERROR_LIST);
        if (list.start[cloud.last] > list.start[cloud.first] && !list.index)
            return sphi_refuse("list", -1, SPH_ERROR_NULL);
    }
    for (i = cloud.first; i < cloud.last; i++)
        for (p = list.start[i] - given.start_base; p < list.start[i + 1] - given.start_base; p++) {
            const sph_index j = list.index[p];
            outside |= (j < 0) | (j >= x.n);
            self |= j == i;
            if (entry_highest < 0 || j < entry_lowest) entry_lowest = j;
            if (j > entry_highest) entry_highest = j;
        }
    if (self) error = SPH_ERROR_SELF;
    if (outside) error = SPH_ERROR_LIST;

    /* The positions: do two components share memory, and is dim right? */
    if (dim > 1 && sphi_same_memory(x.x, x.y, x.stride, x.n, &apart)) geometry = 0;
    else if (dim > 2 && sphi_same_memory(x.x, x.z, x.stride, x.n, &apart)) geometry = 0;
    else if (dim > 2 && sphi_same_memory(x.y, x.z, x.stride, x.n, &apart)) geometry = 0;
    flat = SPHI_SLACK * given.support_ratio * lowest_h;
    if (!geometry) {
        sphi_find(&f, SPH_FINDING_STRIDE, sphi_offender(0, -1, apart));
    } else {
        sph_index other = -1;
        sph_real d = SPH_R(0);
        if (dim < 3) {
            other = sphi_differs(x, x.z == x.y ? 0 : x.z, flat);
            if (other > 0) d = SPHI_ABS(x.z[(size_t)other * x.stride] - x.z[0]);
        }
        if (dim < 2 && other < 0) {
            other = sphi_differs(x, x.y, flat);
            if (other > 0) d = SPHI_ABS(x.y[(size_t)other * x.stride] - x.y[0]);
        }
        if (other > 0) {
            geometry = 0;
            sphi_find(&f, SPH_FINDING_DIM_LOW,
                      sphi_offender(other, 0, d / (given.support_ratio * sphi_at(cloud.h, other))));
        } else if (x.n > 8 && dim > 1 &&
                   (high.x - low.x < flat || high.y - low.y < flat || (dim > 2 && high.z - low.z < flat))) {
            sphi_find(&f, SPH_FINDING_DIM_HIGH, sphi_offender(0, -1, SPH_R(0)));
        }
    }

    /* Rows against all particles: as given; and if something is wrong, as if entries, or entries and starts,
       counted from 1, or as if the stride were in bytes. A guess is right if nothing is missing then. */
    given.cloud = cloud;
    given.dim = dim;
    given.both_sides = both_sides;
    given.extent = sph_subtract(dim, high, low);
    if (samples <= 0) samples = 16;
    if (samples > cloud.last - cloud.first) samples = cloud.last - cloud.first;
    sphi_tally_zero(&tally);
    for (trial = 0; trial < 4 && samples > 0 && geometry; trial++) {
        sphi_case guess = given;
        sphi_tally t;
        if (trial == 1 && given.start_base) break;
        if (trial == 2 && shortest < 1) continue;
        if (trial == 3 && x.stride % sizeof(sph_real)) continue;
        if (trial == 1 || trial == 2) guess.index_base = 1;
        if (trial == 2) guess.start_base = 1;
        if (trial == 3) guess.cloud.points.stride = x.stride / sizeof(sph_real);
        if (trial) guess.with_volumes = 0;
        sphi_tally_rows(k, &guess, samples, extra, &t);
        if (trial == 0) tally = t;
        if (trial == 0 && !t.missing && !outside && !self) break;
        if (trial && t.needed && !t.missing && !t.outside && !t.self && !t.wide) {
            cause = trial;
            break;
        }
    }
    if (samples > 0 &&
        (given.start_base || cause == 1 || cause == 2 || (entry_lowest == 1 && entry_highest == x.n))) {
        sph_offender where = sphi_offender(cloud.first, -1, SPH_R(0));
        for (i = cloud.last; i-- > cloud.first;)
            if (list.start[i + 1] > list.start[i])
                where = sphi_offender(i, list.index[list.start[i] - given.start_base], SPH_R(0));
        sphi_find(&f, SPH_FINDING_LIST_FROM_ONE, where);
    } else if (cause == 3) {
        geometry = 0;
        sphi_find(&f, SPH_FINDING_STRIDE, sphi_offender(0, -1, SPH_R(sizeof(sph_real))));
    } else if (samples > 0 && geometry) {
        sphi_judge_list(&given, &tally, &f);
    }
    if (samples > 0 && geometry) {
        f.sampled = (sph_index)tally.rows;
        f.interior = (sph_index)tally.interior;
        f.sum_lowest = tally.sum_lowest;
        f.sum_highest = tally.sum_highest;
        if (f.interior && !(f.set & ((1u << SPH_FINDING_LIST_STALE) | (1u << SPH_FINDING_BOX)))) {
            if (f.sum_highest > SPH_R(5) || f.sum_lowest > SPH_R(1.5))
                sphi_find(&f, SPH_FINDING_VOLUME_SUM, tally.sum_high);
            else if (f.sum_lowest < SPH_R(0.2) || f.sum_highest < SPH_R(0.67))
                sphi_find(&f, SPH_FINDING_VOLUME_SUM, tally.sum_low);
        }
    }
    for (axis = 0; axis < SPH_FINDING_COUNT; axis++) found += (f.set >> axis & 1u) ? 1 : 0;
    if (!found && error) return sphi_refuse(error == (int)SPH_ERROR_BOX ? "box" : "list", -1, error);
    *out = f;
    return found;
}

#if !SPH_OPENCL
/* The meaning of an sph_finding, and what to do, in words. */
SPH_FN const char *sph_finding_text(int finding)
{
    switch (finding) {
    case SPH_FINDING_LIST_SHORT:
        return "This particle lacks neighbours inside its support: all rows end too early, or are empty. "
               "Build the list with the radius "
               "support * h of the largest h that counts (and again when h has grown).";
    case SPH_FINDING_LIST_SUPPORT:
        return "The list ends at the distance h, not at support * h. Either it was built with the radius h "
               "(build it with "
               "sph_kernel_support), or h holds the support radius (convert it with "
               "sph_kernel_h_from_support). A list that is too "
               "short for another reason looks the same if it happens to end near h.";
    case SPH_FINDING_LIST_HALF:
        return "Each pair stands in one of its two rows only. Build a full list (without SPH_LIST_HALF), or "
               "enter each pair twice.";
    case SPH_FINDING_LIST_ONE_SIDED:
        return "Pairs are missing that lie inside the support of one of their two particles only. Build the "
               "list with the radius that this "
               "operator needs: that of the target (SPH_GATHER), or the larger of both (SPH_LARGER) where it "
               "sums over pairs.";
    case SPH_FINDING_LIST_STALE:
        return "This particle lacks a neighbour although its row, or another, holds particles that are "
               "farther away: the list belongs to other "
               "positions or to another order of the particles. Build it again after particles have moved or "
               "were sorted; if it is new, check "
               "pointers and stride of the positions.";
    case SPH_FINDING_LIST_FROM_ONE:
        return "The list counts from 1. Entries and starts must count from 0: subtract 1.";
    case SPH_FINDING_BOX:
        return "Neighbours through the periodic box do not fit: the box was forgotten, or has another "
               "length, in the cloud or in the list. Give "
               "both the same lengths (sph_points_periodic); the length is that of the period, not the "
               "distance of the outermost particles.";
    case SPH_FINDING_VOLUME_ZERO:
        return "Volumes are negative, or more than half of them are 0. Fill them with m / rho before the "
               "sweep; only probes have the volume 0.";
    case SPH_FINDING_VOLUME_SUM:
        return "The volumes do not fill the space: sum_j V_j W_ij of this particle, in the interior, is far "
               "from 1. Give m / rho, not m, in the "
               "unit length^dim; or h is much shorter than the spacing, or particles are there twice.";
    case SPH_FINDING_DIM_HIGH:
        return "A coordinate is the same for all particles: dim is too high, or the coordinate was never "
               "filled.";
    case SPH_FINDING_DIM_LOW:
        return "These two particles differ in a coordinate beyond dim: dim is too low. If the coordinate is "
               "meant to be left out, give a null "
               "pointer for it.";
    case SPH_FINDING_STRIDE:
        return "The layout of the positions is not what was said: two components share memory, or the stride "
               "counts bytes. Strides count "
               "sph_real; for interleaved coordinates and structs use sph_points_interleaved and "
               "sph_points_strided.";
    default:
        return "no such finding";
    }
}
#endif

SPHI_END
#endif /* SPH_OPS_H */

/*
 * MIT License
 *
 * Copyright (c) 2026 the sph.h authors
 *
 * Permission is hereby granted, free of charge, to any person obtaining a copy
 * of this software and associated documentation files (the "Software"), to deal
 * in the Software without restriction, including without limitation the rights
 * to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
 * copies of the Software, and to permit persons to whom the Software is
 * furnished to do so, subject to the following conditions:
 *
 * The above copyright notice and this permission notice shall be included in all
 * copies or substantial portions of the Software.
 *
 * THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
 * IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
 * FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
 * AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
 * LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
 * OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
 * SOFTWARE.
 */
