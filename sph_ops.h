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
 *   sph_list      neighbour lists in CSR form: target i has index[start[i]] ... index[start[i + 1] - 1]
 *   sph_..._out   where results go: pointers with a stride, so that members of structs are written in
 *                 place; a stride of 0 counts as 1. A null pointer is not wanted, where that makes sense.
 *                 `status` holds an sph_status of each target, and is contiguous.
 *   sph_..._options   what an operator may be told: all zeros are the defaults.
 *   All strides count sph_real.
 *
 *   Sources are the particles 0 ... n - 1, targets some of them. Ghost, boundary and halo particles are
 *   sources that are not targets. Probes (points where a field is wanted) are targets with the volume 0.
 *   Nothing is a valid number: without targets every sweep answers 0 and looks at no array.
 *
 *   Lists must hold every source with r < support (more do no harm), and not the particle itself. h is that
 *   of the target, h_i, unless the operator says otherwise. volume is m / rho (an area in 2D, a length in 1D).
 *   Outputs must not overlap inputs.
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
 * ANSWERS of sweeps: how many targets are not ok (0: all well), or a negative sph_error, and then nothing was
 *   written. `status` says more about each target. Outputs of a target that is SPH_TOO_FEW, SPH_SINGULAR,
 *   SPH_NOT_AVAILABLE or SPH_NOT_FINITE are 0, never a NaN (where there are several outputs, those that are not
 *   finite; h of sph_density_adaptive, which is input and output, stays positive). SPH_REFUSED tells which argument was at fault. With SPH_CHECK = 1 a sweep first
 *   scans all that it reads: positions, h, lists, values. sph_cloud_checked does that once for a cloud.
 *
 * INDEX   (k: kernel, dim: dimension; a name alone: a pair function, or a sibling of the one above)
 *   vectors        sph_dot  sph_scale  sph_subtract  sph_length
 *   views          sph_points_strided  sph_points_separate  sph_points_interleaved  sph_points_periodic
 *                  sph_scalars_strided  sph_scalars_array  sph_scalars_same  sph_scalars_none
 *                  sph_vectors_separate
 *                  sph_vector_out_strided  sph_vector_out_separate
 *                  sph_scalar_out_strided  sph_scalar_out_array
 *   clouds         sph_cloud_of(points, list, h, volume)
 *                  sph_cloud_range(cloud, first, last)
 *                  sph_cloud_checked(dim, cloud)                     scanned once, and marked
 *   interpolation  sph_shepard_sum(k, dim, cloud, out)               gamma_i = sum_j V_j W_ij, with itself
 *                  sph_interpolate_shepard(k, dim, cloud, f, out)    sum_j V_j f_j W_ij / gamma_i
 *   density        sph_density_pair  sph_density_value  sph_density_omega  sph_density_mismatch
 *                  sph_density_summation(k, dim, cloud, m, out)      sum_j m_j W_ij, with itself
 *                  sph_density_adaptive(k, dim, cloud, m, options, out)
 *                      with the h that belongs to it, and Omega
 *   gradients      sph_gradient_pair_difference  sph_moment_weight_gradient  sph_solve_gradient
 *                  sph_gradient_difference(k, dim, cloud, f, out)    sum_j V_j (f_j - f_i) grad_i W_ij
 *                  sph_gradient_cspm(k, dim, cloud, f, out)          corrected: exact for linear fields
 *                  sph_gradient_rows_cspm(k, dim, cloud, out)        the same as rows
 *   Laplacians     sph_laplacian_weight_brookshaw
 *                  sph_laplacian_brookshaw(k, dim, cloud, f, out)    sum_j 2 V_j (f_i - f_j) F_ij
 *                  sph_laplacian_rows_brookshaw(k, dim, cloud, out)
 *   second         sph_test_weights_cspm  sph_test_weights_wls  sph_moments_zero  sph_moments_add
 *   derivatives    sph_moments_add_value  sph_jet_laplacian  sph_solve_cspm  sph_solve_block
 *                  sph_coefficients_weight  sph_coefficients_cspm  sph_coefficients_block
 *                  sph_derivatives_cspm(k, dim, cloud, f, options, out)   gradient, Hessian, Laplacian
 *                  sph_derivatives_icspm(k, dim, cloud, f, options, out)  exact for quadratics
 *                  sph_derivatives_wls(k, dim, cloud, f, options, out)    likewise, by least squares: robust
 *                  sph_derivatives_rows_cspm(k, dim, cloud, d, out)  rows of a combination d of derivatives
 *                  sph_derivatives_rows_icspm(k, dim, cloud, d, out) with the factor kappa
 *                  sph_derivatives_rows_wls(k, dim, cloud, d, out)
 *                  sph_boundary_weight_bim
 *                  sph_second_derivative_bim(k, cloud, f, left, right, out)   1D, with boundary integrals
 *                  sph_second_derivative_rows_bim(k, cloud, left, right, out)
 *   elliptic       (div(m grad u), m a number of each particle)
 *   operator       sph_elliptic_gradient_pair  sph_elliptic_gradient_vector  sph_elliptic_projection
 *                  sph_mobility_pair  sph_elliptic_weight  sph_elliptic_moments_radial
 *                  sph_elliptic_inverse_times  sph_elliptic_invert  sph_sym_eigenvalues
 *                  sph_elliptic_brookshaw(k, dim, cloud, m, options, u, out)
 *                      sum_j V_j (m_i + m_j) (u_i - u_j) F_ij
 *                  sph_elliptic_brookshaw_corrected(k, dim, cloud, m, options, u, out)   times tr C / dim
 *                  sph_elliptic_schwaiger(k, dim, cloud, m, options, u, out)
 *                      exact for linear u and constant m
 *                  sph_elliptic_msph(k, dim, cloud, m, options, u, out)
 *                      the same numbers for radial gradients
 *                  sph_elliptic_rows_brookshaw(k, dim, cloud, m, options, out)
 *                      rows (meshless transmissibilities)
 *                  sph_elliptic_rows_brookshaw_corrected  sph_elliptic_rows_schwaiger  sph_elliptic_rows_msph
 *                  sph_elliptic_diagnose(k, dim, cloud, options, out)
 *                      signs, moments, free-surface indicator
 *                  sph_elliptic_rows_anisotropic(k, dim, cloud, mobility, out)  div(M grad u), M diagonal
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
 *                  sph_viscosity_mu_pair_monaghan_cleary  sph_kernel_f_apart  sph_density_rate_pair_mass
 *                  sph_density_rate_pair_volume
 *                  sph_fluid_pair_monaghan  sph_fluid_pair_colagrossi  sph_fluid_pair_hu_adams
 *                  sph_velocity_pair_xsph  sph_wall_pair_adami  sph_wall_pressure  sph_wall_fluid_velocity
 *                  sph_wall_velocity_no_slip  sph_wall_velocity_free_slip
 *                  sph_pressure_tait  sph_density_tait  sph_sound_speed_tait
 *                  sph_time_step_sound  sph_time_step_force  sph_time_step_viscous_nu
 *                  sph_density_number(k, dim, cloud, m, out)         m_i sum_j W_ij
 *                  sph_fluid_rates_monaghan(k, dim, cloud, fluid, out)    acceleration, density, heating
 *                  sph_fluid_rates_colagrossi, sph_fluid_rates_hu_adams   where the density jumps
 *                  sph_viscosity_mu_morris(k, dim, cloud, fluid, mu, acceleration)   physical viscosity
 *                  sph_viscosity_mu_monaghan_cleary(k, dim, cloud, fluid, mu, acceleration)
 *                  sph_velocity_xsph(k, dim, cloud, fluid, epsilon, change)
 *                  sph_wall_adami(k, dim, cloud, wall, out)          pressure and velocity of wall particles
 *   collisions     sph_collision_pair
 *                  sph_collision_sequential(dim, cloud, collision, velocity, out)
 *                  sph_collision_count(dim, cloud, collision, v, count)
 *                  sph_collision_change_weighted(dim, cloud, collision, v, count, change)
 *   magneto-       sph_mhd_traction  sph_mhd_fast_speed  sph_conductivity_speed
 *   hydrodynamics  sph_cleaning_rate  sph_cleaning_rate_scaled  sph_cleaning_sigma
 *   and            sph_cleaning_rate_velocity  sph_euler_potentials  sph_viscosity_switch_rate
 *   divergence     sph_resistivity_switch  sph_medium_weight  sph_pair_weights_of
 *   cleaning       sph_divergence_pair_difference  sph_curl_pair_difference  sph_medium_difference
 *                  sph_divergence_pair_symmetric  sph_gradient_pair_symmetric
 *                  sph_induction_pair  sph_resistivity_pair  sph_mhd_pair  sph_mhd_value
 *                  sph_divergence_difference(k, dim, cloud, medium, field, out)
 *                  sph_divergence_symmetric(k, dim, cloud, medium, field, out)
 *                  sph_gradient_symmetric(k, dim, cloud, medium, f, out)
 *                  sph_curl_difference(k, dim, cloud, medium, field, out)
 *                  sph_cleaning_rates(k, dim, cloud, state, out)     conservative cleaning of B alone
 *                  sph_mhd_rates(k, dim, cloud, state, out)
 *                      momentum, induction, energy, psi, div B, v_sig
 *   gravity        sph_gravity_pair  sph_gravity_correction_pair  sph_gravity_zeta_value
 *                  sph_gravity_direct(k, cloud, m, newton, acceleration, potential)   all pairs
 *                  sph_gravity_zeta(k, cloud, m, rho, out)
 *                  sph_gravity_correction(k, cloud, medium, zeta, newton, acceleration)
 *                      where h follows the density
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
#ifndef SPH_OPS_H
#define SPH_OPS_H

#include "sph_kernels.h"
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
#else
#  define SPHI_COPYSIGN(x, y) copysign(x, y)
#  define SPHI_LOG(x) log(x)
#  define SPHI_POW(x, y) pow(x, y)
#  define SPHI_SIN(x) sin(x)
#  define SPHI_COS(x) cos(x)
#endif
/* clang-format on */

/* ================================================================ vectors */

typedef struct sph_vec {
    sph_real x, y, z; /* components beyond dim are 0 */
    SPHI_TCC_PAD
} sph_vec;

/* a symmetric tensor */
typedef struct sph_sym {
    sph_real xx, xy, yy, xz, yz, zz;
} sph_sym;

SPH_FN sph_real sph_dot(int dim, sph_vec a, sph_vec b)
{
    sph_real s = a.x * b.x;
    if (dim > 1) s += a.y * b.y;
    if (dim > 2) s += a.z * b.z;
    return s;
}
SPH_FN sph_vec sph_scale(sph_real a, sph_vec v)
{
    v.x *= a;
    v.y *= a;
    v.z *= a;
    return v;
}
SPH_FN sph_vec sph_subtract(int dim, sph_vec a, sph_vec b)
{
    a.x -= b.x;
    if (dim > 1) a.y -= b.y;
    if (dim > 2) a.z -= b.z;
    return a;
}
SPH_FN sph_real sph_length(int dim, sph_vec v) { return SPHI_SQRT(sph_dot(dim, v, v)); }

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

/* ================================================================ views and clouds */

typedef struct sph_points {
    const SPH_GLOBAL sph_real *x, *y, *z; /* y, z are not read below dim 2, 3 */
    size_t stride;                        /* from one particle to the next, in sph_real */
    sph_index n;                          /* number of particles, all sources */
    sph_vec box; /* periodic lengths of the axes; 0: open. Those beyond dim are not read */
} sph_points;

typedef struct sph_scalars {
    const SPH_GLOBAL sph_real *p;
    size_t stride; /* 0: one value for all */
} sph_scalars;

typedef struct sph_list {
    const SPH_GLOBAL sph_index *start, *index;
} sph_list;

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
SPH_FN sph_points sph_points_separate(sph_index n, const SPH_GLOBAL sph_real *x, const SPH_GLOBAL sph_real *y,
                                      const SPH_GLOBAL sph_real *z)
{
    return sph_points_strided(n, x, y, z, 1);
}
/* xyzxyz... (dim numbers per particle) */
SPH_FN sph_points sph_points_interleaved(sph_index n, int dim, const SPH_GLOBAL sph_real *xyz)
{
    return sph_points_strided(n, xyz, dim > 1 && xyz ? xyz + 1 : xyz, dim > 2 && xyz ? xyz + 2 : xyz,
                              (size_t)(dim > 0 ? dim : 0));
}
/* The same points in a box that repeats with the lengths lx, ly, lz; 0 leaves an axis open. Every operator
   then takes the nearest image of each neighbour (BIM, which has ends, excepted). Positions need not be
   wrapped: they may lie up to a million (2^20) lengths from the origin, and lose that many digits there.
   Supports must not reach beyond half a length. */
SPH_FN sph_points sph_points_periodic(sph_points p, sph_real lx, sph_real ly, sph_real lz)
{
    p.box.x = lx;
    p.box.y = ly;
    p.box.z = lz;
    return p;
}
SPH_FN sph_scalars sph_scalars_strided(const SPH_GLOBAL sph_real *p, size_t stride)
{
    sph_scalars s;
    s.p = p;
    s.stride = stride;
    return s;
}
SPH_FN sph_scalars sph_scalars_array(const SPH_GLOBAL sph_real *p) { return sph_scalars_strided(p, 1); }
SPH_FN sph_scalars sph_scalars_same(const SPH_GLOBAL sph_real *value)
{
    return sph_scalars_strided(value, 0);
}
SPH_FN sph_scalars sph_scalars_none(void) { return sph_scalars_strided(0, 0); } /* what is not there */

/* One vector per particle: three component arrays, of which dim are read (or written) */
typedef struct sph_vectors {
    sph_scalars x, y, z;
} sph_vectors;
/* Where results go: separate arrays or members of structs, `stride` sph_real apart (0 counts as 1). A null
   pointer is
   not wanted, where that makes sense. status: an sph_status of each target, contiguous. */
typedef struct sph_vector_out {
    SPH_GLOBAL sph_real *x, *y, *z;
    size_t stride;
} sph_vector_out;
typedef struct sph_scalar_out {
    SPH_GLOBAL sph_real *p;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_scalar_out;
SPH_FN sph_vectors sph_vectors_separate(const SPH_GLOBAL sph_real *x, const SPH_GLOBAL sph_real *y,
                                        const SPH_GLOBAL sph_real *z)
{
    sph_vectors v;
    v.x = sph_scalars_array(x);
    v.y = sph_scalars_array(y);
    v.z = sph_scalars_array(z);
    return v;
}
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
SPH_FN sph_vector_out sph_vector_out_separate(SPH_GLOBAL sph_real *x, SPH_GLOBAL sph_real *y,
                                              SPH_GLOBAL sph_real *z)
{
    return sph_vector_out_strided(x, y, z, 1);
}
SPH_FN sph_scalar_out sph_scalar_out_strided(SPH_GLOBAL sph_real *p, size_t stride,
                                             SPH_GLOBAL unsigned char *status)
{
    sph_scalar_out s;
    s.p = p;
    s.stride = stride;
    s.status = status;
    return s;
}
/* status may be null */
SPH_FN sph_scalar_out sph_scalar_out_array(SPH_GLOBAL sph_real *p, SPH_GLOBAL unsigned char *status)
{
    return sph_scalar_out_strided(p, 1, status);
}

/* Who interacts: sources with their volumes (m / rho; an area in 2D, a length in 1D), the targets first ...
   last - 1 among them, the smoothing length of each and its neighbours. It travels by value, as one argument,
   and owns nothing. */
typedef struct sph_cloud {
    sph_points points;
    sph_list list;
    sph_scalars h, volume;
    sph_index first, last;
    /* 0: every sweep scans what it reads; 1: sph_cloud_checked has done so, and the largest h; negative: it
       found this sph_error, which every sweep then answers */
    int checked;
    sph_real largest_h;
} sph_cloud;
/* All particles as targets. What a sweep does not need may be left out with sph_scalars_none(): volumes where
   it takes masses, h where there is no kernel. */
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
/* The same cloud with the targets first ... last - 1 only: for a host's threads, and for ghosts, which are
   sources alone. Targets that were not checked before have to be checked again. */
SPH_FN sph_cloud sph_cloud_range(sph_cloud cloud, sph_index first, sph_index last)
{
    if (cloud.checked == 1 && (first < cloud.first || last > cloud.last)) cloud.checked = 0;
    cloud.first = first;
    cloud.last = last;
    return cloud;
}

/* Where the derivatives go. */
typedef struct sph_derivatives_out {
    SPH_GLOBAL sph_real *gx, *gy, *gz, *hxx, *hxy, *hyy, *hxz, *hyz, *hzz, *laplacian, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status; /* sph_status, contiguous */
} sph_derivatives_out;

/* Where stencil rows go: D f_i * factor[i] = diagonal[i] f_i + sum_p row[p] f_index[p], p from start[i] to
   start[i + 1] - 1; diagonal = -sum row. All but row may be null. The stride is that of the others, which
   have one number a target. */
typedef struct sph_rows_out {
    SPH_GLOBAL sph_real *row, *diagonal, *factor, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_rows_out;

/* Where the rows of a gradient go: one weight a pair and component; conditioning and status may be null. The
   stride is that of conditioning. */
typedef struct sph_gradient_rows_out {
    SPH_GLOBAL sph_real *x, *y, *z, *conditioning;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_gradient_rows_out;

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
/* d less the nearest multiple of the length, which is 0 for an open axis. Written for loops that must
   vectorise with SSE2: the rounding is a conversion to int and back (rint and floor are library calls there,
   and -ffast-math deletes the trick of adding and subtracting 2^52), and an open axis is masked out instead
   of branched around. The mask also makes a length that is known to be 0 fold away: an int and with 0 is 0 by
   any rule, a product of reals is not. */
SPH_FN sph_real sphi_nearest_image(sph_real d, sph_real length)
{
    const sphi_int32 periodic = length > SPH_R(0);
    const sph_real inverse = (sph_real)periodic / (length + (sph_real)!periodic), t = d * inverse;
    const sphi_int32 images = (sphi_int32)(t + SPHI_COPYSIGN(SPH_R(0.5), t)) & -periodic;
    return d - length * (sph_real)images;
}
/* a - b, the vector from b to a: between the nearest images if p is periodic. All operators form their pair
   vectors here. */
SPH_FN sph_vec sphi_separation(int dim, sph_points p, sph_vec a, sph_vec b)
{
    sph_vec d = sph_subtract(dim, a, b);
    d.x = sphi_nearest_image(d.x, p.box.x);
    if (dim > 1) d.y = sphi_nearest_image(d.y, p.box.y);
    if (dim > 2) d.z = sphi_nearest_image(d.z, p.box.z);
    return d;
}
/* ================================================================ checks */

/* By the bits, because -ffast-math compiles comparisons with NaN away. */
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
/* Stores a value, or 0 if it is not finite; returns 1 then. A null pointer is not wanted. */
SPH_FN int sphi_put(SPH_GLOBAL sph_real *p, size_t stride, sph_index i, sph_real value)
{
    const int ok = sphi_finite(value);
    if (p) p[(size_t)i * stride] = ok ? value : SPH_R(0);
    return p && !ok;
}
SPH_FN size_t sphi_stride(size_t given) { return given ? given : 1; }
/* Stores a vector, or 0 if a component overflowed; returns 1 then. */
SPH_FN int sphi_store_vector(int dim, sph_vector_out out, sph_index i, sph_vec a)
{
    const size_t at = (size_t)i * sphi_stride(out.stride);
    const int lost = !sphi_finite(a.x) || (dim > 1 && !sphi_finite(a.y)) || (dim > 2 && !sphi_finite(a.z));
    out.x[at] = lost ? SPH_R(0) : a.x;
    if (dim > 1) out.y[at] = lost ? SPH_R(0) : a.y;
    if (dim > 2) out.z[at] = lost ? SPH_R(0) : a.z;
    return lost;
}
/* What a target got: the value, or 0 without one, and why. Returns 1 if it is not ok. */
SPH_FN int sphi_answer(sph_scalar_out out, sph_index i, sph_real value, int state)
{
    out.p[(size_t)i * sphi_stride(out.stride)] = value;
    if (out.status) out.status[i] = (unsigned char)state;
    return state != SPH_OK;
}
SPH_FN void sphi_tell(SPH_GLOBAL unsigned char *status, sph_index i, int lost)
{
    if (status) status[i] = (unsigned char)(lost ? SPH_NOT_FINITE : SPH_OK);
}
/* The same for a value that always exists, but may overflow. */
SPH_FN int sphi_store(sph_scalar_out out, sph_index i, sph_real value)
{
    const int ok = sphi_finite(value);
    return sphi_answer(out, i, ok ? value : SPH_R(0), ok ? (int)SPH_OK : (int)SPH_NOT_FINITE);
}
/* The same for the entries first ... last - 1 of a row: all 0 if one overflowed, or their sum, the diagonal.
   */
SPH_FN int sphi_row_finite(SPH_GLOBAL sph_real *row, sph_index first, sph_index last)
{
    sph_real sum = SPH_R(0);
    sph_index p;
    int lost;
    for (p = first; p < last; p++) sum += row[p]; /* not finite if one of them is not */
    lost = !sphi_finite(sum);
    if (lost)
        for (p = first; p < last; p++) row[p] = SPH_R(0);
    return lost;
}
/* What goes with the row of a target; with_diagonal: what the row lacks to the sum 0. */
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

/* What a sweep refuses: the name of an argument, and the first particle at fault, or -1. */
SPH_FN int sphi_refuse(SPHI_TEXT *argument, sph_index particle, int error)
{
    (void)argument;
    (void)particle;
    SPH_REFUSED(argument, particle, error);
    return error;
}
/* Checks return 0, a negative sph_error, or this: there are no targets, so nothing else is looked at. */
enum { SPHI_NO_TARGETS = 1 };
SPH_FN int sphi_answer_of(int error) { return error < 0 ? error : 0; }

/* Scans, in two passes, because the first vectorises: is there a fault, and where? */
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
/* Smoothing lengths or radii; *largest grows to the largest. */
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
/* Coordinates: finite, and so is the difference of any two. */
SPHI_LARGE int sphi_scan_places(SPHI_TEXT *name, const SPH_GLOBAL sph_real *x, size_t stride, sph_index n)
{
    sph_index i;
    int bad = 0;
    for (i = 0; i < n; i++) bad |= !sphi_finite(SPH_R(2) * x[(size_t)i * stride]);
    if (!bad) return 0;
    for (i = 0; sphi_finite(SPH_R(2) * x[(size_t)i * stride]);) i++;
    return sphi_refuse(name, i, SPH_ERROR_POSITION);
}
/* Coordinates on a periodic axis: the images can be counted in 32 bits. */
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
/* The rows first ... last - 1 of a list of n sources, which the targets are themselves unless foreign. */
SPHI_LARGE int sphi_scan_entries(sph_index first, sph_index last, sph_list list, sph_index n, int foreign)
{
    sph_index i, p;
    int outside = 0, self = 0;
    for (i = first; i < last; i++)
        if (list.start[i + 1] < list.start[i]) return sphi_refuse("list", i, SPH_ERROR_LIST);
    for (i = first; i < last; i++)
        for (p = list.start[i]; p < list.start[i + 1]; p++) {
            const sph_index j = list.index[p];
            outside |= (j < 0) | (j >= n);
            self |= j == i;
        }
    if (!outside && (!self || foreign)) return 0;
    for (i = first; i < last; i++)
        for (p = list.start[i]; p < list.start[i + 1]; p++) {
            const sph_index j = list.index[p];
            if (outside ? j < 0 || j >= n : j == i)
                return sphi_refuse("list", i, outside ? (int)SPH_ERROR_LIST : (int)SPH_ERROR_SELF);
        }
    return SPH_ERROR_LIST;
}

/* One axis: the length, that no radius (support * h) of the largest h reaches beyond half of it, and that the
   images of positions can be counted in 32 bits (unless a scan has found that). */
SPH_FN int sphi_check_axis(sph_real length, sph_real largest, const SPH_GLOBAL sph_real *x, size_t stride,
                           sph_index n, int scanned)
{
    if (!sphi_finite(length) || length < SPH_R(0)) return sphi_refuse("box", -1, SPH_ERROR_BOX);
    if (!(length > SPH_R(0))) return 0;
    /* a denormal number */
    if (!sphi_finite(SPH_R(1) / length)) return sphi_refuse("box", -1, SPH_ERROR_BOX);
    /* with room for rounding: a host may have computed h from half the box */
    if (!(largest <= SPH_R(0.5) * length * (SPH_R(1) + SPH_R(4) * SPH_EPSILON)))
        return sphi_refuse("box", -1, SPH_ERROR_BOX);
    return SPH_CHECK && !scanned ? sphi_scan_images(length, x, stride, n) : 0;
}
SPH_FN int sphi_check_box(int dim, sph_points x, sph_real largest, int scanned)
{
    int error = sphi_check_axis(x.box.x, largest, x.x, x.stride, x.n, scanned);
    if (!error && dim > 1) error = sphi_check_axis(x.box.y, largest, x.y, x.stride, x.n, scanned);
    if (!error && dim > 2) error = sphi_check_axis(x.box.z, largest, x.z, x.stride, x.n, scanned);
    return error;
}

/* The arrays of positions, of points that there are. */
SPH_FN int sphi_check_arrays(int dim, sph_points x)
{
    if (!x.x || (dim > 1 && !x.y) || (dim > 2 && !x.z)) return sphi_refuse("points", -1, SPH_ERROR_NULL);
    return x.stride < 1 ? sphi_refuse("points.stride", -1, SPH_ERROR_COUNT) : 0;
}
/* Which targets: what all sweeps over clouds share. */
SPH_FN int sphi_check_targets(int dim, sph_cloud cloud)
{
    if (dim < 1 || dim > 3) return sphi_refuse("dim", -1, SPH_ERROR_DIM);
    if (cloud.checked < 0) return cloud.checked;
    if (cloud.points.n < 0) return sphi_refuse("points.n", -1, SPH_ERROR_COUNT);
    if (cloud.first < 0 || cloud.first > cloud.last || cloud.last > cloud.points.n)
        return sphi_refuse("first, last", -1, SPH_ERROR_RANGE);
    return cloud.first == cloud.last ? SPHI_NO_TARGETS : 0;
}
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
    return error;
}
/* The rows first ... last - 1 of a list of n sources, which the targets are themselves unless foreign.
   Without SPH_CHECK their ends alone. */
SPH_FN int sphi_check_entries(sph_index first, sph_index last, sph_list list, sph_index n, int foreign)
{
    if (first == last) return 0;
    if (list.start[first] < 0 || list.start[last] < list.start[first])
        return sphi_refuse("list", first, SPH_ERROR_LIST);
    if (list.start[last] > list.start[first] && !list.index) return sphi_refuse("list", -1, SPH_ERROR_NULL);
    return SPH_CHECK ? sphi_scan_entries(first, last, list, n, foreign) : 0;
}
/* The positions, the box for sums that reach as far as `largest`, and the rows of the targets. */
SPH_FN int sphi_check_scan(int dim, sph_cloud cloud, sph_real largest)
{
    const int scanned = cloud.checked == 1;
    int error = scanned ? 0 : sphi_check_positions(dim, cloud.points);
    if (!error) error = sphi_check_box(dim, cloud.points, largest, scanned);
    if (error || scanned) return error;
    return sphi_check_entries(cloud.first, cloud.last, cloud.list, cloud.points.n, 0);
}
/* Sweeps without a kernel: lists that reach as far as `distance`. */
SPH_FN int sphi_check_list(int dim, sph_cloud cloud, sph_real distance)
{
    const int error = sphi_check_frame(dim, cloud);
    return error ? error : sphi_check_scan(dim, cloud, distance);
}
SPH_FN int sphi_check_h(SPHI_TEXT *name, sph_scalars h, sph_index n, sph_real *largest)
{
    return SPH_CHECK ? sphi_scan_h(name, h, n, largest) : 0;
}
/* nothing else is said of values that there are */
SPH_FN int sphi_check_finite(SPHI_TEXT *name, sph_scalars a, sph_index n, int error)
{
    return SPH_CHECK ? sphi_scan_finite(name, a, n, error) : 0;
}
SPH_FN int sphi_check_kernel(sph_kernel k)
{
    return (unsigned)k >= (unsigned)SPH_KERNEL_COUNT ? sphi_refuse("kernel", -1, SPH_ERROR_KERNEL) : 0;
}
SPH_FN int sphi_check_field(SPHI_TEXT *name, sph_scalars f, sph_index n)
{
    return f.p ? sphi_check_finite(name, f, n, SPH_ERROR_VALUE) : sphi_refuse(name, -1, SPH_ERROR_NULL);
}
/* Sweeps with a kernel: h, and what weighs the neighbours (volumes or masses), too. */
SPH_FN int sphi_check_sweep(sph_kernel k, int dim, sph_cloud cloud, SPHI_TEXT *name, sph_scalars weights)
{
    const int scanned = cloud.checked == 1;
    sph_real largest = cloud.largest_h;
    int error = sphi_check_frame(dim, cloud);
    if (error >= 0 && sphi_check_kernel(k)) return SPH_ERROR_KERNEL;
    if (!error && !cloud.h.p) error = sphi_refuse("h", -1, SPH_ERROR_NULL);
    if (!error && !weights.p) error = sphi_refuse(name, -1, SPH_ERROR_NULL);
    if (!error && !scanned) error = sphi_check_h("h", cloud.h, cloud.points.n, &largest);
    if (!error && !(scanned && weights.p == cloud.volume.p && weights.stride == cloud.volume.stride))
        error = sphi_check_finite(name, weights, cloud.points.n, SPH_ERROR_VALUE);
    return error ? error : sphi_check_scan(dim, cloud, sph_kernel_support_ratio(k) * largest);
}
/* after the checks of the sweep: where a vector goes */
SPH_FN int sphi_check_out(SPHI_TEXT *name, int dim, sph_vector_out out)
{
    const int there = out.x && (dim < 2 || out.y) && (dim < 3 || out.z);
    return there ? 0 : sphi_refuse(name, -1, SPH_ERROR_NULL);
}

/* Scans positions, box, lists, h and volumes (if the cloud has them) once, and returns the cloud marked:
   sweeps then scan only what they read besides, until something changes and the mark is made anew. If
   something is wrong the mark is the sph_error, and every sweep answers that. */
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

/* Only asked for where a system was singular: was it for want of neighbours? */
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
    return error;
}
SPH_FN int sphi_check_positive(SPHI_TEXT *name, sph_scalars a, sph_index n)
{
    const int error = sphi_check_field(name, a, n);
    return error || !SPH_CHECK ? error : sphi_scan_positive(name, a, n);
}
SPH_FN int sphi_check_not_negative(SPHI_TEXT *name, sph_scalars a, sph_index n)
{
    const int error = sphi_check_field(name, a, n);
    return error || !SPH_CHECK ? error : sphi_scan_not_negative(name, a, n);
}

/* ================================================================ small systems: dense, at most 6 x 6. Rows
   are stored 6 apart. */

enum { SPHI_MAX = 6 };
typedef struct sphi_lu {
    sph_real a[SPHI_MAX][SPHI_MAX];
    int row[SPHI_MAX];
    /* smallest |pivot|: a measure of singularity, because the matrices come scaled to a unit diagonal */
    sph_real pivot_min;
    sph_real sign; /* sign of the determinant */
} sphi_lu;

/* A pivot below this is round-off of a matrix whose entries are of order one. */
#define SPHI_PIVOT_MIN (SPH_R(64) * SPH_EPSILON)

/* LU with partial pivoting. A pivot below SPHI_PIVOT_MIN is replaced by it, so that solutions stay finite and
   show the null direction. */
SPH_FN void sphi_lu_factor(int n, sphi_lu *s)
{
    int i, j, c;
    s->pivot_min = SPH_R(1);
    s->sign = SPH_R(1);
    for (c = 0; c < n; c++) {
        int best = c;
        sph_real p;
        for (i = c + 1; i < n; i++)
            if (SPHI_ABS(s->a[i][c]) > SPHI_ABS(s->a[best][c])) best = i;
        s->row[c] = best;
        if (best != c) {
            s->sign = -s->sign;
            for (j = 0; j < n; j++) {
                const sph_real t = s->a[c][j];
                s->a[c][j] = s->a[best][j];
                s->a[best][j] = t;
            }
        }
        p = SPHI_ABS(s->a[c][c]);
        if (!(p >= s->pivot_min)) s->pivot_min = p;
        if (s->a[c][c] < SPH_R(0)) s->sign = -s->sign;
        if (!(p >= SPHI_PIVOT_MIN)) s->a[c][c] = s->a[c][c] < SPH_R(0) ? -SPHI_PIVOT_MIN : SPHI_PIVOT_MIN;
        p = SPH_R(1) / s->a[c][c];
        for (i = c + 1; i < n; i++) {
            const sph_real m = s->a[i][c] *= p;
            for (j = c + 1; j < n; j++) s->a[i][j] -= m * s->a[c][j];
        }
    }
}
SPH_FN void sphi_lu_solve(int n, const sphi_lu *s, sph_real *b)
{
    int i, j;
    for (i = 0; i < n; i++) {
        const int p = s->row[i];
        const sph_real t = b[p];
        b[p] = b[i];
        b[i] = t;
    }
    for (i = 1; i < n; i++)
        for (j = 0; j < i; j++) b[i] -= s->a[i][j] * b[j];
    for (i = n - 1; i >= 0; i--) {
        for (j = i + 1; j < n; j++) b[i] -= s->a[i][j] * b[j];
        b[i] /= s->a[i][i];
    }
}
/* y = m x, and y = m^T x; m is rows x cols */
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
 * With q = r_ij / h_i and W = sigma / h^dim w(q), all that density and smoothing length need are two sums
 * over the neighbours and the particle itself (q = 0):
 *     S = sum_j m_j w(q),   T = -sum_j m_j q w'(q) >= 0 (for kernels that fall monotonically)
 *     rho = sigma / h^dim S,   d rho/dh = (rho / h) (T / S - dim),   Omega = 1 + h / (dim rho) d rho/dh = T /
 *     (dim S).
 * h = eta (m / rho)^(1/dim) is sigma S / m = eta^dim, whose left side only grows with h: from sigma w(0) (and
 * whatever coincides with the particle) to sigma w(0) sum m_j / m: one solution at most, and none if eta^dim
 * lies outside.
 * Springel & Hernquist 2002, MNRAS 333, 649 (1/Omega is their f_i); Price & Monaghan 2004, MNRAS 348, 139:
 * Omega = 1 - dh/drho sum_j m_j dW_ij(h_i)/dh_i with dh/drho = -h / (dim rho); the relation of h and rho is
 * (10) of Price 2012, JCP 231, 759. Omega is near 1 where the density is uniform, above 1 where it rises with
 * the distance from the particle, and 0 for a particle without neighbours.
 */

typedef struct sph_density_sums {
    sph_real weight, slope;
} sph_density_sums;

/* the contribution of a neighbour at q = r / h; of the particle itself at q = 0 */
SPH_FN sph_density_sums sph_density_pair(sph_kernel k, int dim, sph_real q, sph_real m_j)
{
    sph_density_sums c;
    c.weight = m_j * sph_kernel_shape(k, dim, q);
    c.slope = -m_j * q * q * sph_kernel_shape_f(k, dim, q);
    return c;
}
/* rho = sigma / h^dim S */
SPH_FN sph_real sph_density_value(sph_kernel k, int dim, sph_density_sums s, sph_real h)
{
    return sph_kernel_sigma(k, dim) * sphi_power(SPH_R(1) / h, dim) * s.weight;
}
/* Omega = T / (dim S): no difference of nearly equal numbers, however few the neighbours */
SPH_FN sph_real sph_density_omega(int dim, sph_density_sums s) { return s.slope / (SPH_R(dim) * s.weight); }
/* ln(eta (m / rho)^(1/dim) / h): 0 for the h that belongs to rho, positive where h is too short. Its
   derivative by ln h is -Omega. S and m must be positive. */
SPH_FN sph_real sph_density_mismatch(sph_kernel k, int dim, sph_density_sums s, sph_real m, sph_real eta)
{
    return SPHI_LOG(eta) - SPHI_LOG(sph_kernel_sigma(k, dim) * s.weight / m) / SPH_R(dim);
}

/* -------- interpolation: sweeps */

/* sum_j w_j W_ij, the particle itself included; w: volumes or masses */
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
        SPH_SUM(sum)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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
/* gamma_i = sum_j V_j W_ij, the particle itself included: 1 in the interior of a regular cloud, about 1/2 at
   a plane boundary. Shepard 1968; (4.10) of the ICSPM paper. */
SPH_FN sph_index sph_shepard_sum(sph_kernel k, int dim, sph_cloud cloud, sph_scalar_out out)
{
    return sphi_sum_of_weights(k, dim, cloud, "volume", cloud.volume, out);
}

/* f_i = sum_j V_j f_j W_ij / sum_j V_j W_ij, the particle itself included: exact for constants, O(h^2) in the
   interior, O(h) at a boundary. A target of volume 0 is a probe. SPH_TOO_FEW where the sum of weights is not
   positive. */
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
        SPH_SUM(sum, sum_f)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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

/* rho_i = sum_j m_j W_ij(h_i), the particle itself included (its mass counts; 0 for a probe): error O(h^2) in
   the interior of a regular cloud, about rho/2 at a free surface. h is given: for one that follows rho see
   below. */
SPH_FN sph_index sph_density_summation(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                       sph_scalar_out out)
{
    return sphi_sum_of_weights(k, dim, cloud, "m", m, out);
}

SPH_FN sph_density_sums sphi_density_sums(sph_kernel k, int dim, sph_index i, sph_points x, sph_list list,
                                          sph_real h_i, sph_scalars m)
{
    const sph_vec x_i = sphi_point(dim, x, i);
    const sph_real u = SPH_R(1) / h_i;
    sph_density_sums sums = sph_density_pair(k, dim, SPH_R(0), sphi_at(m, i));
    sph_real weight = sums.weight, slope = sums.slope;
    sph_index p;
    SPH_SUM(weight, slope)
    for (p = list.start[i]; p < list.start[i + 1]; p++) {
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

/* an h just so short that only coincident neighbours are in the support */
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

/* Newton's method in ln h (exact in one step where rho h^dim is a power of h) between bounds low < root <=
   high as far as they are known (0: not yet). A step that leaves the bounds, or follows one that did not
   halve the mismatch, is replaced: by the longest h while there is no upper bound, by the shortest that can
   matter while there is no lower one, else by bisection in ln h. A mismatch is halved at most 64 times, and
   bounds as far apart as numbers can be close in at most 64: hence the number of steps. */
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
        if (sums->weight >
            SPH_R(0)) { /* else negative lobes or masses outweigh the rest, as if it were too short */
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

/* Where h would have to be longer than the list allows: SPH_LIST_TOO_SHORT and an h to build the next one
   for, or SPH_TOO_FEW if no list could help. */
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
    } else if (list.start[i + 1] - list.start[i] >=
               x.n - 1) { /* the whole cloud: is all its mass at the distance 0 enough? */
        sph_density_sums all = sph_density_pair(k, dim, SPH_R(0), sphi_at(m, i));
        for (p = list.start[i]; p < list.start[i + 1]; p++)
            all.weight += sph_density_pair(k, dim, SPH_R(0), sphi_at(m, list.index[p])).weight;
        if (!(all.weight > SPH_R(0)) || !(sph_density_mismatch(k, dim, all, sphi_at(m, i), eta) < SPH_R(0)))
            return SPH_TOO_FEW;
    }
    if (sums.weight > SPH_R(0) && sums.slope > SPH_R(0)) {
        const sph_real e =
            sph_density_mismatch(k, dim, sums, sphi_at(m, i), eta) / sph_density_omega(dim, sums);
        if (e < SPH_R(0.6))
            grow = SPH_R(1.05) *
                   SPHI_EXP(
                       e); /* with a margin: an h that is a little too short again would cost another list */
    }
    if (!sphi_finite(*h * grow)) return SPH_TOO_FEW;
    *h = longest > SPH_R(0) && *h * grow > longest ? longest : *h * grow;
    return SPH_LIST_TOO_SHORT;
}

typedef struct sph_density_options {
    sph_scalars list_radius; /* row i of the list holds every source with r < list_radius_i; has no default */
    sph_real eta;            /* h = eta (m / rho)^(1/dim); 0: sph_kernel_h_over_dx(k) */
    sph_real tolerance;      /* of h, relative, below 1; 0: 1e-3. Less than 64 round-offs counts as that */
} sph_density_options;
/* h holds the guess, and the answer; omega and status may be null. The stride is that of h, rho and omega. */
typedef struct sph_density_out {
    SPH_GLOBAL sph_real *h, *rho, *omega;
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_density_out;

/* Density and smoothing length that belong together: h_i = eta (m_i / rho_i)^(1/dim), rho_i = sum_j m_j
   W_ij(h_i) with the particle itself, to |eta (m_i / rho_i)^(1/dim) / h_i - 1| <= tolerance, and Omega_i = 1
   + h_i / (dim rho_i) sum_j m_j dW_ij/dh_i, the factor of equations of motion with that h (see the pair tier:
   sources, sign). On a lattice of spacing dx, h = eta dx but for the kernel's error there. Never diverges; a
   good guess costs two or three passes over the row.
   list_radius  h_i is never made longer than list_radius_i / support. At most half a periodic length.
   h            in: a guess for the targets (any positive number); out: the result.
   SPH_LIST_TOO_SHORT   h would have to be longer. h[i] is the one to try next (at most twice the longest that
                        was allowed), rho and omega are those at list_radius_i / support. Build a list that is
                        longer where h[i] * support exceeds list_radius_i and call again; or stop at the
                        longest h that makes sense, and keep rho and omega.
   SPH_TOO_FEW          no h will do, because all the sources there are (or, in a periodic box, all within
                        half of it) have too little mass: a particle alone, for which rho h^dim is a constant
                        and every h or none fits. h[i] = list_radius_i / support, rho and omega 0.
   SPH_SINGULAR         no h is short enough: the particle (and what coincides with it) has more than eta^dim
                        allows at any h: eta is too small, or particles have clumped in one point. rho and
                        omega 0, h[i] too short to hold any other particle (or the guess, if that was).
   SPH_NOT_AVAILABLE    m_i is not positive: rho and omega 0, h[i] as it was.
   SPH_ILL_CONDITIONED  rho jumps across the solution, as kernels do that are cut off at their edge (the
                        Gaussians): h[i] is the place of the jump, the rest as computed there.
   SPH_NOT_FINITE       the sums overflowed: rho and omega 0, h[i] where that happened.
   Besides the errors of all sweeps: SPH_ERROR_H for a guess or a list_radius that is not finite and
   positive, SPH_ERROR_VALUE for eta or tolerance out of range, SPH_ERROR_BOX for a list_radius beyond half
   the box. Ranges
   may run in parallel: of h only the range's own entries are read. */
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
    if (!error) error = sphi_check_h("list_radius", radius, cloud.points.n, &longest_radius);
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
            /* a radius that is a denormal number may leave no h at all */
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

/* ================================================================ gradients and two-point Laplacians */

/* V_j (f_j - f_i) grad_i W_ij: exact for constants; error O(h^2) in the interior where the particles are
   regular, O(1) at a boundary. Monaghan 1992, ARA&A 30, 543, in difference form. */
SPH_FN sph_vec sph_gradient_pair_difference(sph_kernel k, int dim, sph_real V_j, sph_real df, sph_vec x_ij,
                                            sph_real r, sph_real h)
{
    return sph_scale(V_j * df * sph_kernel_f(k, dim, r, h), x_ij);
}

/* Weight of (f_j - f_i) in Brookshaw's Laplacian: -2 V_j F_ij >= 0. L f_i = sum_j weight (f_j - f_i) = sum_j
   2 V_j (f_i - f_j) F_ij. Brookshaw 1985, Proc. ASA 6, 207. Error O(h^2) in the interior of a regular cloud,
   O(1/h) at a boundary and O(1) or worse in disorder. */
SPH_FN sph_real sph_laplacian_weight_brookshaw(sph_kernel k, int dim, sph_real r, sph_real h, sph_real V_j)
{
    return SPH_R(-2) * V_j * sph_kernel_f(k, dim, r, h);
}

/* The gradient alone needs K only:  sum weight e_a e_b  with the weight  -V_j F_ij  (h cancels against the e
   of the right-hand side), grad = K^-1 sum weight e df. */
SPH_FN sph_real sph_moment_weight_gradient(sph_kernel k, int dim, sph_real r, sph_real h, sph_real V_j)
{
    return -V_j * sph_kernel_f(k, dim, r, h);
}

/* Inverse of the symmetric K, scaled to a unit diagonal for the test of singularity. Returns SPH_OK or
   SPH_SINGULAR (nothing written); *conditioning, if wanted, is the smallest pivot in [0, 1]. */
SPH_FN int sph_solve_gradient(int dim, sph_sym moment, sph_sym *inverse, sph_real *conditioning)
{
    sph_real a, b, c, p, q, l, n, s, t;
    if (dim < 3) moment.zz = SPH_R(1), moment.xz = moment.yz = SPH_R(0);
    if (dim < 2) moment.yy = SPH_R(1), moment.xy = SPH_R(0);
    if (!(moment.xx > SPH_R(0)) || !(moment.yy > SPH_R(0)) || !(moment.zz > SPH_R(0))) return SPH_SINGULAR;
    a = SPH_R(1) / SPHI_SQRT(moment.xx);
    b = SPH_R(1) / SPHI_SQRT(moment.yy);
    c = SPH_R(1) / SPHI_SQRT(moment.zz);
    moment.xy *= a * b;
    moment.xz *= a * c;
    moment.yz *= b * c;
    /* By K = L D L^T, D = (1, p, q): cofactors over the determinant would lose twice as many digits where K
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

/* grad f_i = sum_j V_j (f_j - f_i) grad_i W_ij, not corrected */
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
        SPH_SUM(sx, sy, sz)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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

/* K = sum weight e e and, if asked for, D = sum weight e df, with e = x_j - x_i */
SPH_FN void sphi_gradient_moments(sph_kernel k, int dim, sph_index i, sph_points x, sph_list list,
                                  sph_real h_i, sph_scalars volume, int with_f, sph_scalars f,
                                  sph_sym *moment, sph_vec *sum)
{
    const sph_vec x_i = sphi_point(dim, x, i);
    const sph_real f_i = with_f ? sphi_at(f, i) : SPH_R(0);
    sph_real xx = SPH_R(0), xy = SPH_R(0), yy = SPH_R(0), xz = SPH_R(0), yz = SPH_R(0), zz = SPH_R(0),
             sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
    sph_index p;
    SPH_SUM(xx, xy, yy, xz, yz, zz, sx, sy, sz)
    for (p = list.start[i]; p < list.start[i + 1]; p++) {
        const sph_index j = list.index[p];
        const sph_vec e = sphi_separation(dim, x, sphi_point(dim, x, j), x_i);
        const sph_vec we =
            sph_scale(sph_moment_weight_gradient(k, dim, sph_length(dim, e), h_i, sphi_at(volume, j)), e);
        const sph_real df = with_f ? sphi_at(f, j) - f_i : SPH_R(0);
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

/* grad f_i = K^-1 sum_j V_j (-F_ij) e (f_j - f_i), K = sum_j V_j (-F_ij) e e^T, e = x_j - x_i: exact for
   linear fields at any particle; error O(h^2) inside, O(h) at a boundary. Randles & Libersky 1996, CMAME 139,
   375; CSPM (3.5) of the ICSPM paper in 1D (with W', where its list under (5.17) prints W). conditioning (may
   be null): smallest pivot of K scaled to a unit diagonal. Needs dim neighbours that are not on a line or in
   a plane. */
SPH_FN sph_index sph_gradient_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
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
        sphi_gradient_moments(k, dim, i, cloud.points, cloud.list, h_i, cloud.volume, 1, f, &moment, &sum);
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

/* The same as rows: grad f_i = sum_p (wx[p], wy[p], wz[p]) (f_j - f_i), p along the list. */
SPH_FN sph_index sph_gradient_rows_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_gradient_rows_out out)
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
        sphi_gradient_moments(k, dim, i, cloud.points, cloud.list, h_i, cloud.volume, 0, cloud.volume,
                              &moment, &sum);
        state = sph_solve_gradient(dim, moment, &inverse, &pivot);
        if (state) state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i, dim);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_vec e =
                sphi_separation(dim, cloud.points, sphi_point(dim, cloud.points, cloud.list.index[p]), x_i);
            sph_vec w = sph_scale(SPH_R(0), e);
            if (!state)
                w = sphi_sym_times(
                    dim, inverse,
                    sph_scale(sph_moment_weight_gradient(k, dim, sph_length(dim, e), h_i,
                                                         sphi_at(cloud.volume, cloud.list.index[p])),
                              e));
            wx[p] = w.x;
            if (dim > 1) wy[p] = w.y;
            if (dim > 2) wz[p] = w.z;
        }
        {
            int lost = sphi_row_finite(wx, cloud.list.start[i], cloud.list.start[i + 1]);
            if (dim > 1) lost |= sphi_row_finite(wy, cloud.list.start[i], cloud.list.start[i + 1]);
            if (dim > 2) lost |= sphi_row_finite(wz, cloud.list.start[i], cloud.list.start[i + 1]);
            if (lost) state = SPH_NOT_FINITE;
            for (p = cloud.list.start[i]; lost && p < cloud.list.start[i + 1]; p++) {
                wx[p] = SPH_R(0);
                if (dim > 1) wy[p] = SPH_R(0);
                if (dim > 2) wz[p] = SPH_R(0);
            }
        }
        sphi_put(out.conditioning, sphi_stride(out.stride), i, pivot);
        if (out.status) out.status[i] = (unsigned char)state;
        failed += state != SPH_OK;
    }
    return failed;
}

/* -------- two-point Laplacians: sweeps */

/* L f_i = sum_j 2 V_j (f_i - f_j) F_ij; see sph_laplacian_weight_brookshaw */
SPH_FN sph_index sph_laplacian_brookshaw(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                         sph_scalar_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), f_i = sphi_at(f, i);
        sph_real sum = SPH_R(0);
        SPH_SUM(sum)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j));
            sum +=
                sph_laplacian_weight_brookshaw(k, dim, sph_length(dim, x_ij), h_i, sphi_at(cloud.volume, j)) *
                (sphi_at(f, j) - f_i);
        }
        failed += sphi_store(out, i, sum);
    }
    return failed;
}
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
        SPH_EACH
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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
 * One system serves CSPM, ICSPM and weighted least squares. With e = (x_j - x_i) / h = -x_ij / h and df = f_j
 * - f_i, Taylor's series
 *     df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...
 * is summed against the test functions  g e_a  (dim of them) and  w e_a e_b, a <= b  (dim (dim + 1) / 2 of
 * them):
 *     [ K  B ] [ h grad f ]   [ sum g e df   ]        K = sum g e e,  B = sum g e ee,
 *     [ A  M ] [ h^2 hess ] = [ sum w e e df ]        A = sum w ee e, M = sum w ee ee.
 *   CSPM   g = -V_j F_ij, w = V_j W_ij / r^2.  grad = K^-1 (...) as if B were 0; then hess = M^-1 (... - A
 *          grad). In 1D: (3.5), (5.15).
 *   ICSPM  the same tests, solved as the coupled system it is. In 1D: (5.17), hess = hess_CSPM / kappa with
 *          kappa = 1 - A B / (K M).
 *   WLS    g = w = V_j W_ij: the normal equations of a weighted least-squares fit of a quadratic (moving
 *          least squares at the particle).
 * CSPM: Chen, Beraun & Carney 1999, IJNME 46, 231. ICSPM: Korzilius, Schilders & Anthonissen 2017, J. Appl.
 * Math. Phys. 5, 168, in 1D; the n-dimensional form with the matrix kappa = 1 - M^-1 A K^-1 B is its natural
 * extension and reduces to it exactly.
 * Misprints there that are corrected here: (4.14), (5.17) print kappa with a plus sign; the list under (5.17)
 * prints W instead of W' in <f'>; section II prints dW/dy, which is -dW/dx. tests/test_derivatives.c shows
 * that the printed forms fail.
 * Exact for:  CSPM gradient: linear fields. CSPM Hessian: quadratic fields in the interior of symmetric
 *             clouds only. ICSPM, WLS: quadratic fields, for any positions and volumes.
 * Errors:     interior, regular: O(h^2) all. At a boundary: CSPM gradient O(h), Hessian O(1); ICSPM and WLS
 *             gradient O(h^2), Hessian O(h).
 * kappa:      det(kappa) is 1 in the interior, negative for one-sided neighbours, and so 0 somewhere in
 *             between (in 1D at 0.30 h from the end of the domain for wendland-c4-1d). There ICSPM amplifies
 *             rounding and truncation; its conditioning number tells, and WLS, whose matrix is definite, is
 *             the fallback.
 */

/* Weights of the test functions */
typedef struct sph_test_weights {
    sph_real g, w;
} sph_test_weights;

/* q = r / h. The normalisation of the kernel cancels and is left out. */
SPH_FN sph_test_weights sph_test_weights_cspm(sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    sph_test_weights t;
    t.g = -V_j * sph_kernel_shape_f(k, dim, q);
    t.w = V_j * sphi_over_q(sph_kernel_shape(k, dim, q), q * q);
    return t;
}
SPH_FN sph_test_weights sph_test_weights_wls(sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    sph_test_weights t;
    t.g = t.w = V_j * sph_kernel_shape(k, dim, q);
    return t;
}

/* The sums: name and contribution of a neighbour at e = (x, y, z). Y is what 2D adds to 1D, Z what 3D adds to
   2D. */
/* clang-format off */
#define SPHI_MATRIX_X(X) X(gxx, g * x * x) X(gxxx, g * x * x * x) X(wxxx, w * x * x * x) \
    X(wxxxx, w * x * x * x * x)
#define SPHI_MATRIX_Y(X) \
    X(gxy, g * x * y) X(gyy, g * y * y) X(gxxy, g * x * x * y) X(gxyy, g * x * y * y) X(gyyy, g * y * y * y) \
    X(wxxy, w * x * x * y) X(wxyy, w * x * y * y) X(wyyy, w * y * y * y) \
    X(wxxxy, w * x * x * x * y) X(wxxyy, w * x * x * y * y) X(wxyyy, w * x * y * y * y) \
    X(wyyyy, w * y * y * y * y)
#define SPHI_MATRIX_Z(X) \
    X(gxz, g * x * z) X(gyz, g * y * z) X(gzz, g * z * z) X(gxxz, g * x * x * z) X(gxyz, g * x * y * z) \
    X(gyyz, g * y * y * z) \
    X(gxzz, g * x * z * z) X(gyzz, g * y * z * z) X(gzzz, g * z * z * z) X(wxxz, w * x * x * z) \
    X(wxyz, w * x * y * z) X(wyyz, w * y * y * z) \
    X(wxzz, w * x * z * z) X(wyzz, w * y * z * z) X(wzzz, w * z * z * z) X(wxxxz, w * x * x * x * z) \
    X(wxxyz, w * x * x * y * z) \
    X(wxyyz, w * x * y * y * z) X(wyyyz, w * y * y * y * z) X(wxxzz, w * x * x * z * z) \
    X(wxyzz, w * x * y * z * z) X(wyyzz, w * y * y * z * z) \
    X(wxzzz, w * x * z * z * z) X(wyzzz, w * y * z * z * z) X(wzzzz, w * z * z * z * z)
#define SPHI_VALUE_X(X) X(gfx, g * df * x) X(wfxx, w * df * x * x)
#define SPHI_VALUE_Y(X) X(gfy, g * df * y) X(wfxy, w * df * x * y) X(wfyy, w * df * y * y)
#define SPHI_VALUE_Z(X) X(gfz, g * df * z) X(wfxz, w * df * x * z) X(wfyz, w * df * y * z) \
    X(wfzz, w * df * z * z)
#define SPHI_MATRIX(dim, X) \
    SPHI_MATRIX_X(X) if (dim > 1) { SPHI_MATRIX_Y(X) } if (dim > 2) { SPHI_MATRIX_Z(X) }
#define SPHI_VALUE(dim, X) SPHI_VALUE_X(X) if (dim > 1) { SPHI_VALUE_Y(X) } if (dim > 2) { SPHI_VALUE_Z(X) }
/* clang-format on */

#define SPHI_FIELD(name, formula) sph_real name;
/* clang-format off */
typedef struct sph_moments {
    SPHI_MATRIX_X(SPHI_FIELD) SPHI_MATRIX_Y(SPHI_FIELD) SPHI_MATRIX_Z(SPHI_FIELD)
    SPHI_VALUE_X(SPHI_FIELD) SPHI_VALUE_Y(SPHI_FIELD) SPHI_VALUE_Z(SPHI_FIELD)
} sph_moments;
/* clang-format on */

#define SPHI_ZERO(name, formula) s.name = SPH_R(0);
SPH_FN sph_moments sph_moments_zero(void)
{
    sph_moments s;
    SPHI_MATRIX(3, SPHI_ZERO)
    SPHI_VALUE(3, SPHI_ZERO)
    return s;
}

/* Adds a neighbour's part of the matrix (and, with the second function, of the right-hand side): e = (x_j -
   x_i) / h_i, t from sph_test_weights_*, df = f_j - f_i. */
#define SPHI_ADD(name, formula) s->name += formula;
SPH_FN void sph_moments_add(int dim, sph_moments *s, sph_vec e, sph_test_weights t)
{
    const sph_real x = e.x, y = e.y, z = e.z, g = t.g, w = t.w;
    (void)y;
    (void)z;
    SPHI_MATRIX(dim, SPHI_ADD)
}
SPH_FN void sph_moments_add_value(int dim, sph_moments *s, sph_vec e, sph_test_weights t, sph_real df)
{
    const sph_real x = e.x, y = e.y, z = e.z, g = t.g, w = t.w;
    (void)y;
    (void)z;
    SPHI_VALUE(dim, SPHI_ADD)
}

/* First and second derivatives: as a result, the derivatives of f; as an operator, the coefficients of D f =
   sum gradient_a d_a f + sum_{a <= b} hessian_ab d_a d_b f (so hessian.xx = hessian.yy = hessian.zz = 1 and
   the rest 0 is the Laplacian, and each mixed derivative counts once). */
typedef struct sph_jet {
    sph_vec gradient;
    sph_sym hessian;
} sph_jet;

/* the operator D = Laplacian */
SPH_FN sph_jet sph_jet_laplacian(int dim)
{
    sph_jet d;
    d.gradient.x = d.gradient.y = d.gradient.z = d.hessian.xy = d.hessian.xz = d.hessian.yz = SPH_R(0);
    d.hessian.xx = SPH_R(1);
    d.hessian.yy = dim > 1 ? SPH_R(1) : SPH_R(0);
    d.hessian.zz = dim > 2 ? SPH_R(1) : SPH_R(0);
    return d;
}

/* -------- the block system. Unknowns in the order (x, y, z) and (xx, xy, yy, xz, yz, zz), so that lower
   dimensions are the leading parts; as second unknown the coefficient of e_a e_b (half the derivative for a =
   b). Rows and columns are scaled to unit diagonals of K and M: conditioning then does not depend on units.
   */

/* of the Hessian */
SPH_FN int sphi_unknowns(int dim)
{
    SPH_ASSERT(dim >= 1 && dim <= 3);
    return dim == 1 ? 1 : dim == 2 ? 3 : 6;
}

typedef struct sphi_blocks {
    sph_real kk[SPHI_MAX][SPHI_MAX], bb[SPHI_MAX][SPHI_MAX], aa[SPHI_MAX][SPHI_MAX], mm[SPHI_MAX][SPHI_MAX];
    sph_real s[SPHI_MAX], d[SPHI_MAX]; /* scales of the gradient's and the Hessian's unknowns */
} sphi_blocks;

#define SPHI_SET(m, i, j, value) b->m[i][j] = b->m[j][i] = (value);
/* Returns 0 where a diagonal entry is not positive: no neighbour in that direction (or negative volumes). */
SPH_FN int sphi_blocks_fill(int dim, const sph_moments *m, sphi_blocks *b)
{
    const int nh = sphi_unknowns(dim);
    int i, j;
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
    for (i = 0; i < dim; i++) {
        if (!(b->kk[i][i] > SPH_R(0))) return 0;
        b->s[i] = SPH_R(1) / SPHI_SQRT(b->kk[i][i]);
    }
    for (i = 0; i < nh; i++) {
        if (!(b->mm[i][i] > SPH_R(0))) return 0;
        b->d[i] = SPH_R(1) / SPHI_SQRT(b->mm[i][i]);
    }
    for (i = 0; i < dim; i++) {
        for (j = 0; j < dim; j++) b->kk[i][j] *= b->s[i] * b->s[j];
        for (j = 0; j < nh; j++) {
            b->bb[i][j] *= b->s[i] * b->d[j];
            b->aa[j][i] *= b->s[i] * b->d[j];
        }
    }
    for (i = 0; i < nh; i++)
        for (j = 0; j < nh; j++) b->mm[i][j] *= b->d[i] * b->d[j];
    return 1;
}
#undef SPHI_SET

/* the right-hand side, scaled like the rows */
SPH_FN void sphi_blocks_values(int dim, const sph_moments *m, const sphi_blocks *b, sph_real *u, sph_real *v)
{
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

/* From scaled unknowns to derivatives, and from the coefficients of an operator on derivatives to those on
   the unknowns. */
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

SPH_FN void sphi_lu_load(int n, sphi_lu *s, sph_real (*m)[SPHI_MAX])
{
    int i, j;
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) s->a[i][j] = m[i][j];
    sphi_lu_factor(n, s);
}

/* The blocks, and K and M factored: SPH_OK, or SPH_SINGULAR if the neighbours do not determine a gradient or
   a Hessian at all. */
SPH_FN int sphi_blocks_factor(int dim, const sph_moments *m, sphi_blocks *b, sphi_lu *kk, sphi_lu *mm)
{
    if (!sphi_blocks_fill(dim, m, b)) return SPH_SINGULAR;
    sphi_lu_load(dim, kk, b->kk);
    sphi_lu_load(sphi_unknowns(dim), mm, b->mm);
    return kk->pivot_min < SPHI_PIVOT_MIN || mm->pivot_min < SPHI_PIVOT_MIN ? SPH_SINGULAR : SPH_OK;
}

/* the Schur complement S = M - A K^-1 B, or its transpose, factored */
SPH_FN void sphi_schur(int dim, const sphi_blocks *b, const sphi_lu *kk, int transposed, sphi_lu *schur)
{
    const int nh = sphi_unknowns(dim);
    int i, j, c;
    for (j = 0; j < nh; j++) {
        sph_real x[SPHI_MAX];
        for (i = 0; i < dim; i++) x[i] = b->bb[i][j];
        sphi_lu_solve(dim, kk, x);
        for (i = 0; i < nh; i++) {
            sph_real y = b->mm[i][j];
            for (c = 0; c < dim; c++) y -= b->aa[i][c] * x[c];
            schur->a[transposed ? j : i][transposed ? i : j] = y;
        }
    }
    sphi_lu_factor(nh, schur);
}

/* sign(det kappa) / |kappa^-1|, kappa^-1 = S^-1 M, in the norm of the largest row sum: 1 in the interior, in
   1D just kappa */
SPH_FN sph_real sphi_conditioning(int dim, const sphi_blocks *b, const sphi_lu *schur)
{
    const int nh = sphi_unknowns(dim);
    sph_real sum[SPHI_MAX], largest = SPH_R(0);
    int i, j;
    for (i = 0; i < nh; i++) sum[i] = SPH_R(0);
    for (j = 0; j < nh; j++) {
        sph_real x[SPHI_MAX];
        for (i = 0; i < nh; i++) x[i] = b->mm[i][j];
        sphi_lu_solve(nh, schur, x);
        for (i = 0; i < nh; i++) sum[i] += SPHI_ABS(x[i]);
    }
    for (i = 0; i < nh; i++)
        if (!(sum[i] <= largest)) largest = sum[i];
    return schur->sign / largest;
}

/* Gradient and Hessian by CSPM from the moments. Returns SPH_OK or SPH_SINGULAR (nothing written).
   *conditioning, if wanted, is the smallest pivot of the scaled K and M, in [0, 1]: 1 for isotropic K, 0
   where the neighbours do not determine the answer (it depends a little on the order of the axes). */
SPH_FN int sph_solve_cspm(int dim, const sph_moments *m, sph_real h, sph_jet *jet, sph_real *conditioning)
{
    const int nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm;
    sph_real u[SPHI_MAX], v[SPHI_MAX], t[SPHI_MAX];
    int i;
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    sphi_blocks_values(dim, m, &b, u, v);
    sphi_lu_solve(dim, &kk, u);
    sphi_multiply(nh, dim, b.aa, u, t);
    for (i = 0; i < nh; i++) v[i] -= t[i];
    sphi_lu_solve(nh, &mm, v);
    *jet = sphi_jet_unscaled(dim, &b, h, u, v);
    if (conditioning) *conditioning = kk.pivot_min < mm.pivot_min ? kk.pivot_min : mm.pivot_min;
    return SPH_OK;
}

/* Gradient and Hessian by ICSPM or WLS (the moments tell which). Returns SPH_OK or SPH_SINGULAR (nothing
   written). *conditioning, if wanted, is kappa in 1D and sign(det kappa) / |kappa^-1| in general: what ICSPM
   multiplies the errors of CSPM by is 1 / |conditioning|. */
SPH_FN int sph_solve_block(int dim, const sph_moments *m, sph_real h, sph_jet *jet, sph_real *conditioning)
{
    const int nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm, schur;
    sph_real u[SPHI_MAX], v[SPHI_MAX], x[SPHI_MAX], t[SPHI_MAX];
    int i;
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    sphi_schur(dim, &b, &kk, 0, &schur);
    if (schur.pivot_min < SPHI_PIVOT_MIN) return SPH_SINGULAR;
    sphi_blocks_values(dim, m, &b, u, v);
    for (i = 0; i < dim; i++) x[i] = u[i];
    sphi_lu_solve(dim, &kk, x);
    sphi_multiply(nh, dim, b.aa, x, t);
    for (i = 0; i < nh; i++) v[i] -= t[i];
    sphi_lu_solve(nh, &schur, v);
    sphi_multiply(dim, nh, b.bb, v, t);
    for (i = 0; i < dim; i++) u[i] -= t[i];
    sphi_lu_solve(dim, &kk, u);
    *jet = sphi_jet_unscaled(dim, &b, h, u, v);
    if (conditioning) *conditioning = sphi_conditioning(dim, &b, &schur);
    return SPH_OK;
}

/* -------- rows. The weight of (f_j - f_i) in the operator D is  g c.first . e + w c.second : ee  with
   coefficients c that depend on i only. */

typedef struct sph_coefficients {
    sph_vec first;
    sph_sym second;
    sph_real factor; /* sum_j weight (f_j - f_i) = factor * D f: 1, or kappa for ICSPM */
} sph_coefficients;

SPH_FN sph_real sph_coefficients_weight(int dim, sph_coefficients c, sph_vec e, sph_test_weights t)
{
    sph_real second = c.second.xx * e.x * e.x;
    if (dim > 1) second += (c.second.xy * e.x + c.second.yy * e.y) * e.y;
    if (dim > 2) second += (c.second.xz * e.x + c.second.yz * e.y + c.second.zz * e.z) * e.z;
    return t.g * sph_dot(dim, c.first, e) + t.w * second;
}

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

/* Row of the operator op by CSPM. Returns SPH_OK or SPH_SINGULAR (nothing written). *conditioning as for
   sph_solve_cspm. */
SPH_FN int sph_coefficients_cspm(int dim, const sph_moments *m, sph_real h, sph_jet op, sph_coefficients *c,
                                 sph_real *conditioning)
{
    const int nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm;
    sph_real u[SPHI_MAX], v[SPHI_MAX], t[SPHI_MAX];
    int i;
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    sphi_operator_scaled(dim, &b, h, op, u, v);
    sphi_lu_solve(nh, &mm, v); /* K and M are symmetric */
    sphi_multiply_transposed(nh, dim, b.aa, v, t);
    for (i = 0; i < dim; i++) u[i] -= t[i];
    sphi_lu_solve(dim, &kk, u);
    *c = sphi_row_unscaled(dim, &b, u, v, SPH_R(1));
    if (conditioning) *conditioning = kk.pivot_min < mm.pivot_min ? kk.pivot_min : mm.pivot_min;
    return SPH_OK;
}

/* Row of the operator op by ICSPM (icspm = 1) or WLS (icspm = 0). Returns SPH_OK or SPH_SINGULAR (nothing
   written).
   ICSPM rows are never divided by kappa: they are scaled to the size of the CSPM row, and the factor goes to
   the right-hand side. In 1D the row is the CSPM row and the factor is kappa, as published; in general row
   and factor are those of (op row) * factor with |M^T second| the same as in CSPM, so that both stay finite
   where kappa is singular (factor 0 then: the row still annihilates what it must). *conditioning is the same
   as for sph_solve_block. */
SPH_FN int sph_coefficients_block(int dim, int icspm, const sph_moments *m, sph_real h, sph_jet op,
                                  sph_coefficients *c, sph_real *conditioning)
{
    const int nh = sphi_unknowns(dim);
    sphi_blocks b;
    sphi_lu kk, mm, schur;
    sph_real u[SPHI_MAX], v[SPHI_MAX], y[SPHI_MAX], t[SPHI_MAX], factor = SPH_R(1);
    int i;
    if (sphi_blocks_factor(dim, m, &b, &kk, &mm)) return SPH_SINGULAR;
    if (conditioning || !icspm) {
        sphi_schur(dim, &b, &kk, 0, &schur);
        if (!icspm && schur.pivot_min < SPHI_PIVOT_MIN) return SPH_SINGULAR;
        if (conditioning) *conditioning = sphi_conditioning(dim, &b, &schur);
    }
    sphi_operator_scaled(dim, &b, h, op, u, y);
    for (i = 0; i < dim; i++) t[i] = u[i];
    sphi_lu_solve(dim, &kk, t);
    sphi_multiply_transposed(dim, nh, b.bb, t, v);
    for (i = 0; i < nh; i++) y[i] = v[i] = y[i] - v[i];
    sphi_schur(dim, &b, &kk, 1, &schur);
    sphi_lu_solve(nh, &schur, v);
    if (icspm) { /* |y|: what M^T v is in CSPM; t = M v: what it is here (M is symmetric) */
        sph_real yy = SPH_R(0), tt = SPH_R(0), yt = SPH_R(0);
        sphi_multiply(nh, nh, b.mm, v, t);
        for (i = 0; i < nh; i++) {
            yy += y[i] * y[i];
            tt += t[i] * t[i];
            yt += y[i] * t[i];
        }
        if (yy > SPH_R(0) && tt > SPH_R(0)) factor = yt < SPH_R(0) ? -SPHI_SQRT(yy / tt) : SPHI_SQRT(yy / tt);
        for (i = 0; i < nh; i++) v[i] *= factor;
        for (i = 0; i < dim; i++) u[i] *= factor;
    }
    sphi_multiply_transposed(nh, dim, b.aa, v, t);
    for (i = 0; i < dim; i++) u[i] -= t[i];
    sphi_lu_solve(dim, &kk, u);
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

enum { SPHI_CSPM, SPHI_ICSPM, SPHI_WLS };
SPH_FN sph_test_weights sphi_test_weights(int method, sph_kernel k, int dim, sph_real q, sph_real V_j)
{
    return method == SPHI_WLS ? sph_test_weights_wls(k, dim, q, V_j) : sph_test_weights_cspm(k, dim, q, V_j);
}

/* Fifty sums do not stay in registers one pair at a time: neighbours are gathered into tiles and summed in
   lanes, which vectorises without a flag. Rows are filled up with a neighbour out of reach, whose weights are
   0. */
enum { SPHI_TILE = 64, SPHI_LANES = 8 };
typedef struct sphi_tile {
    sph_real x[SPHI_TILE], y[SPHI_TILE], z[SPHI_TILE], q[SPHI_TILE], volume[SPHI_TILE], df[SPHI_TILE];
} sphi_tile;

/* e = (x_j - x_i) / h_i, q = |e|, V_j and f_j - f_i of up to SPHI_TILE neighbours; returns their number
   rounded up to whole lanes */
SPH_FN int sphi_tile_gather(int dim, int with_f, sphi_tile *t, sph_vec x_i, sph_real h_i, sph_real f_i,
                            sph_points x, sph_scalars volume, sph_scalars f,
                            const SPH_GLOBAL sph_index *index, int n)
{
    const int full = (n + SPHI_LANES - 1) / SPHI_LANES * SPHI_LANES;
    const sph_real u = SPH_R(1) / h_i;
    int c, l;
    for (c = 0; c < n; c++) {
        const sph_index j = index[c];
        const sph_vec e = sph_scale(u, sphi_separation(dim, x, sphi_point(dim, x, j), x_i));
        t->x[c] = e.x;
        if (dim > 1) t->y[c] = e.y;
        if (dim > 2) t->z[c] = e.z;
        t->volume[c] = sphi_at(volume, j);
        if (with_f) t->df[c] = sphi_at(f, j) - f_i;
    }
    for (c = n; c < full; c++) {
        t->x[c] = SPH_R(64);
        if (dim > 1) t->y[c] = SPH_R(0);
        if (dim > 2) t->z[c] = SPH_R(0);
        t->volume[c] = t->df[c] = SPH_R(0);
    }
    for (c = 0; c < full; c += SPHI_LANES)
        for (l = 0; l < SPHI_LANES; l++) {
            sph_real s = t->x[c + l] * t->x[c + l];
            if (dim > 1) s += t->y[c + l] * t->y[c + l];
            if (dim > 2) s += t->z[c + l] * t->z[c + l];
            t->q[c + l] = SPHI_SQRT(s);
        }
    return full;
}

#define SPHI_LANE_FIELD(name, formula) sph_real name[SPHI_LANES];
/* clang-format off */
typedef struct sphi_lanes {
    SPHI_MATRIX_X(SPHI_LANE_FIELD) SPHI_MATRIX_Y(SPHI_LANE_FIELD) SPHI_MATRIX_Z(SPHI_LANE_FIELD)
    SPHI_VALUE_X(SPHI_LANE_FIELD) SPHI_VALUE_Y(SPHI_LANE_FIELD) SPHI_VALUE_Z(SPHI_LANE_FIELD)
} sphi_lanes;
/* clang-format on */
#define SPHI_LANE_ZERO(name, formula) s.name[l] = SPH_R(0);
#define SPHI_LANE_ADD(name, formula) s.name[l] += formula;
#define SPHI_LANE_SUM(name, formula) \
    for (l = 1; l < SPHI_LANES; l++) s.name[0] += s.name[l]; \
    m->name = s.name[0];

/* the moments of target i, as sph_moments_add and sph_moments_add_value make them */
SPH_FN void sphi_moments(int method, sph_kernel k, int dim, int with_f, sph_index i, sph_points pos,
                         sph_list list, sph_real h_i, sph_scalars volume, sph_scalars f, sph_moments *m)
{
    const sph_vec x_i = sphi_point(dim, pos, i);
    const sph_real f_i = with_f ? sphi_at(f, i) : SPH_R(0);
    const sph_index end = list.start[i + 1];
    sphi_tile t;
    sphi_lanes s;
    sph_index left; /* counted down: beyond the last entry there may be no index to count up to */
    int l, c;
    for (l = 0; l < SPHI_LANES; l++) {
        SPHI_MATRIX(dim, SPHI_LANE_ZERO)
        if (with_f) { SPHI_VALUE(dim, SPHI_LANE_ZERO) }
    }
    for (left = end - list.start[i]; left > 0; left -= SPHI_TILE) {
        const int full =
            sphi_tile_gather(dim, with_f, &t, x_i, h_i, f_i, pos, volume, f, list.index + (end - left),
                             left < SPHI_TILE ? (int)left : (int)SPHI_TILE);
        for (c = 0; c < full; c += SPHI_LANES)
            for (l = 0; l < SPHI_LANES; l++) {
                const sph_test_weights tw = sphi_test_weights(method, k, dim, t.q[c + l], t.volume[c + l]);
                const sph_real x = t.x[c + l], y = dim > 1 ? t.y[c + l] : SPH_R(0),
                               z = dim > 2 ? t.z[c + l] : SPH_R(0), g = tw.g, w = tw.w;
                (void)y;
                (void)z;
                SPHI_MATRIX(dim, SPHI_LANE_ADD)
                if (with_f) {
                    const sph_real df = t.df[c + l];
                    SPHI_VALUE(dim, SPHI_LANE_ADD)
                }
            }
    }
    *m = sph_moments_zero(); /* what dim leaves out, too: a compiler that does not know dim would warn */
    SPHI_MATRIX(dim, SPHI_LANE_SUM)
    if (with_f) { SPHI_VALUE(dim, SPHI_LANE_SUM) }
}

/* unknowns that the neighbours must determine: CSPM solves for gradient and Hessian one after the other, the
   others at once */
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

/* What the sweeps over derivatives may be told; zeros are the defaults. */
typedef struct sph_derivatives_options {
    sph_real conditioning_min; /* a target whose |conditioning| is below is SPH_ILL_CONDITIONED; 0: none is */
    int fallback_wls; /* ICSPM: 1: targets that are singular or ill-conditioned get the least-squares value */
} sph_derivatives_options;

SPH_FN sph_index sphi_derivatives(int method, sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                  sph_derivatives_options options, sph_derivatives_out out)
{
    const size_t stride = sphi_stride(out.stride);
    const sph_real conditioning_min = options.conditioning_min;
    const int fallback_wls = method == SPHI_ICSPM && options.fallback_wls;
    const int want_conditioning = out.conditioning || conditioning_min > SPH_R(0);
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    sph_index i, failed = 0;
    if (!error) error = sphi_check_field("f", f, cloud.points.n);
    if (!error && (!sphi_finite(conditioning_min) || conditioning_min < SPH_R(0)))
        error = sphi_refuse("conditioning_min", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_moments m;
        sph_jet j;
        sph_real conditioning = SPH_R(0);
        int state, solved;
        sphi_moments(method, k, dim, 1, i, cloud.points, cloud.list, h_i, cloud.volume, f, &m);
        state = sphi_solve(method, dim, &m, h_i, &j, want_conditioning ? &conditioning : 0);
        solved = state == SPH_OK;
        if (!sphi_finite(conditioning)) conditioning = SPH_R(0); /* moments that overflowed */
        if (!solved)
            state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i,
                                         sphi_neighbours_needed(method, dim));
        else if (want_conditioning && SPHI_ABS(conditioning) < conditioning_min) state = SPH_ILL_CONDITIONED;
        if (fallback_wls && (state == SPH_SINGULAR || state == SPH_ILL_CONDITIONED)) {
            sphi_moments(SPHI_WLS, k, dim, 1, i, cloud.points, cloud.list, h_i, cloud.volume, f, &m);
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

/* Gradient, Hessian and Laplacian by CSPM: (3.5), (5.15) of the ICSPM paper in 1D. The Hessian has an error
   O(1) at boundaries: in 1D it is kappa f''. conditioning: smallest pivot of the scaled matrices, in [0, 1];
   a target below conditioning_min (>= 0) is reported SPH_ILL_CONDITIONED, its value kept. */
SPH_FN sph_index sph_derivatives_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                      sph_derivatives_options options, sph_derivatives_out out)
{
    return sphi_derivatives(SPHI_CSPM, k, dim, cloud, f, options, out);
}

/* Gradient, Hessian and Laplacian by ICSPM: (5.17) of the ICSPM paper in 1D. Exact for quadratic fields
   wherever it is not singular. conditioning: kappa in 1D, sign(det kappa) / |kappa^-1| in general. Targets
   whose |conditioning| is below conditioning_min (>= 0; where there are boundaries and disorder 0.2 is a good
   value in 1D and 0.02 in 2D and 3D; 0 is the published method) are SPH_ILL_CONDITIONED and keep their value,
   or, with fallback_wls = 1, get the least-squares one and are SPH_FELL_BACK. */
SPH_FN sph_index sph_derivatives_icspm(sph_kernel k, int dim, sph_cloud cloud, sph_scalars f,
                                       sph_derivatives_options options, sph_derivatives_out out)
{
    return sphi_derivatives(SPHI_ICSPM, k, dim, cloud, f, options, out);
}

/* Gradient, Hessian and Laplacian by weighted least squares: the robust sibling. Exact for quadratic fields;
   the matrix is definite wherever the neighbours determine a quadratic. conditioning: as for ICSPM, here in
   [0, 1]. */
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
        const sph_real h_i = sphi_at(cloud.h, i), u = SPH_R(1) / h_i;
        SPH_GLOBAL sph_real *const row = out.row;
        sph_moments m;
        sph_coefficients c;
        sph_real conditioning = SPH_R(0), sum = SPH_R(0);
        int state;
        c.factor = SPH_R(0);
        sphi_moments(method, k, dim, 0, i, cloud.points, cloud.list, h_i, cloud.volume, cloud.volume, &m);
        state = method == SPHI_CSPM
                    ? sph_coefficients_cspm(dim, &m, h_i, d, &c, out.conditioning ? &conditioning : 0)
                    : sph_coefficients_block(dim, method == SPHI_ICSPM, &m, h_i, d, &c,
                                             out.conditioning ? &conditioning : 0);
        if (state)
            state = sphi_singular_status(k, dim, i, cloud.points, cloud.list, h_i,
                                         sphi_neighbours_needed(method, dim));
        else {
            for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
                const sph_index j = cloud.list.index[p];
                const sph_vec e =
                    sph_scale(u, sphi_separation(dim, cloud.points, sphi_point(dim, cloud.points, j), x_i));
                row[p] = sph_coefficients_weight(
                    dim, c, e,
                    sphi_test_weights(method, k, dim, sph_length(dim, e), sphi_at(cloud.volume, j)));
                sum += row[p];
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

/* Stencil rows of the operator d (see sph_jet): sum_p row[p] (f_j - f_i) = factor_i D f_i. The rows of a
   target that is not ok are 0, and so is its factor. */
SPH_FN sph_index sph_derivatives_rows_cspm(sph_kernel k, int dim, sph_cloud cloud, sph_jet d,
                                           sph_rows_out out)
{
    return sphi_derivative_rows(SPHI_CSPM, k, dim, cloud, d, out);
}

/* ICSPM: factor is the kappa of the paper (in 1D the rows are those of CSPM and the boundary value problem is
   sum_p row[p] (u_j - u_i) = kappa_i f''(x_i)): nothing is ever divided by kappa, so a target where kappa is
   0 is ok here. */
SPH_FN sph_index sph_derivatives_rows_icspm(sph_kernel k, int dim, sph_cloud cloud, sph_jet d,
                                            sph_rows_out out)
{
    return sphi_derivative_rows(SPHI_ICSPM, k, dim, cloud, d, out);
}
SPH_FN sph_index sph_derivatives_rows_wls(sph_kernel k, int dim, sph_cloud cloud, sph_jet d, sph_rows_out out)
{
    return sphi_derivative_rows(SPHI_WLS, k, dim, cloud, d, out);
}

/* -------- BIM, one dimension */

/* 1D, BIM: weight of (f_b - f_i) for the end b of the domain at x_b, whose outer normal is `normal` (+1
   right, -1 left):  2 normal W(x_i - x_b) / (x_b - x_i). Macia, Gonzalez, Cercos-Pita & Souto-Iglesias 2012,
   Prog. Theor. Phys. 128, 439; (4.9) of the ICSPM paper, where the braces are lost in print: the factor
   2/gamma multiplies the boundary terms, too. Undefined (0/0) at the end itself: do not call it there. */
SPH_FN sph_real sph_boundary_weight_bim(sph_kernel k, sph_real e, sph_real normal, sph_real h)
{
    return SPH_R(2) * normal * sph_kernel_w(k, 1, SPHI_ABS(e), h) / e;
}

SPH_FN int sphi_check_ends(sph_points x, sph_index left, sph_index right)
{
    if (x.box.x > SPH_R(0)) return sphi_refuse("box", -1, SPH_ERROR_BOX); /* a periodic axis has no ends */
    if (left < 0 || left >= x.n || right < 0 || right >= x.n)
        return sphi_refuse("left, right", -1, SPH_ERROR_RANGE);
    return x.x[(size_t)left * x.stride] < x.x[(size_t)right * x.stride]
               ? 0
               : sphi_refuse("left, right", left, SPH_ERROR_POSITION);
}
/* not available at (or beyond) the ends; too few without a neighbour in the support, because the sum would
   then be a silent 0 */
SPH_FN int sphi_bim_status(sph_kernel k, sph_index i, sph_points x, sph_list list, sph_real h,
                           sph_real x_left, sph_real x_right)
{
    const sph_real x_i = sphi_point(1, x, i).x;
    if (!(x_i > x_left && x_i < x_right)) return SPH_NOT_AVAILABLE;
    return sphi_singular_status(k, 1, i, x, list, h, 1) == SPH_TOO_FEW ? SPH_TOO_FEW : SPH_OK;
}

/* f''_i = (1/gamma_i) { sum_j 2 V_j (f_i - f_j) F_ij + boundary terms at the particles `left` and `right` },
   gamma_i the Shepard sum. (5.16) of the ICSPM paper. First order near a boundary if h grows against the
   spacing, as the integrals demand. Not available (SPH_NOT_AVAILABLE, 0) at the ends themselves. */
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
            SPH_SUM(sum, gamma)
            for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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

/* The same as rows: f''_i = sum_p row[p] (f_j - f_i). The ends must be in the lists of the targets that reach
   them. */
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

/* ================================================================ elliptic operator
 *
 * L u = div(m grad u) as a sum of two-point fluxes. With e = x_j - x_i (from the particle to its neighbour)
 * and g_ij = grad_i W_ij = -F_ij e,
 *     L u_i = sum_j T_ij (u_j - u_i),   T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij),   t_ij = e . g_ij /
 *     |e|^2,   mu_ij = m_i + m_j,
 * where each particle has, from the moments of its neighbourhood
 *     Gamma = sum V_j t e e^T,   K = sum V_j e g^T = C^-1,   N = sum V_j g,   N~ = sum V_j t e,
 *     Brookshaw             scale = 1                    xi = 0
 *     corrected Brookshaw   scale = tr K^-1 / dim        xi = 0
 *     Schwaiger             scale = tr Gamma^-1 / dim    xi = K^-1 N
 *     M-SPH                 scale = tr Gamma^-1 / dim    xi = K^-1 N~      (on request Gamma* = Gamma - sum
 *                           V_j (xi . g) e e^T for Gamma)
 * Lukyanov & Vuik 2020, arXiv:1711.11351: (27), (51), (52), (69), and (24), (53), (55), (65), (71) for the
 * moments; T_ij is their meshless transmissibility (90). Brookshaw 1985, Proc. ASA 6, 207. Schwaiger 2008,
 * IJNME 75, 647.
 * Exact for: Brookshaw constants only. Corrected Brookshaw linear fields where N = 0. Schwaiger and M-SPH
 * with constant m: linear fields at every particle, for any positions and volumes; with xx, xy, yy and cubic
 * fields in the interior of lattices. Of the second derivatives only the trace is normalised (nearly: see
 * options.trace): in disorder errors are O(1) in the pointwise sense for all four, at a boundary O(1) for the
 * last two and O(1/h) for the first two.
 * Signs: L is negative semi-definite where all T >= 0, which is where 1 - xi . e > 0 ((92), (93);
 * sph_elliptic_diagnose). The paper's (1) is -L u - g. Misprints and misreadings that are corrected here:
 * (52) does have the two-point form, because m_j u_j - m_i u_i - u_i (m_j - m_i) + m_i (u_j - u_i) = (m_i +
 * m_j) (u_j - u_i): with N = N~ Schwaiger's scheme and M-SPH are the same numbers, for the radial gradients
 * (15), (17), (18), any cloud and any m. (91) has the sign of G wrong, and (71) as printed starts with C^-1,
 * which is not Gamma for the gradient (16): here it is Gamma. The factor of the cubic spline
 * under (12) is 2/3 in 1D, not 3/2. (70) asks whether Gamma* is 0; it must be definite. (69) with a matrix M
 * is inconsistent unless neighbours lie on the axes only (examples/papers/elliptic_msph_diagonal.h);
 * sph_elliptic_rows_anisotropic is not. tests/test_elliptic.c shows that the printed forms fail.
 */

/* Which gradient of the kernel stands for g; nu_i = sum_j V_j W_ij, the particle itself included. All but
   FULL are radial (along e). */
typedef enum sph_elliptic_gradient {
    SPH_GRADIENT_DIFFUSE, /* (15) grad W */
    SPH_GRADIENT_FULL,    /* (16) grad (W / nu): nu is differentiated, too. Best at boundaries in M-SPH */
    SPH_GRADIENT_SHEPARD_DIFFUSE, /* (17) grad W / nu */
    SPH_GRADIENT_SHEPARD_FULL /* (18) grad_j (W / nu): with the neighbour's own part of nu differentiated */
} sph_elliptic_gradient;

/* The mobility of a pair. */
typedef enum sph_mobility_mean {
    SPH_MOBILITY_ARITHMETIC, /* (m_i + m_j) / 2: as published */
    SPH_MOBILITY_HARMONIC,   /* 2 m_i m_j / (m_i + m_j): keeps the flux through a jump */
    SPH_MOBILITY_UPWIND      /* that of the particle with the higher potential */
} sph_mobility_mean;

/* nu and grad nu of a particle */
typedef struct sph_shepard {
    sph_real nu;
    sph_vec gradient;
} sph_shepard;

/* g = radial e + rest */
typedef struct sph_kernel_gradient {
    sph_real radial;
    sph_vec rest; /* 0 but for SPH_GRADIENT_FULL */
} sph_kernel_gradient;

SPH_FN sph_kernel_gradient sph_elliptic_gradient_pair(int gradient, sph_wf v, sph_real V_j, sph_shepard s)
{
    sph_kernel_gradient g;
    g.radial = -v.f;
    g.rest.x = g.rest.y = g.rest.z = SPH_R(0);
    if (gradient == (int)SPH_GRADIENT_FULL) {
        g.radial /= s.nu;
        g.rest = sph_scale(-v.w / (s.nu * s.nu), s.gradient);
    } else if (gradient == (int)SPH_GRADIENT_SHEPARD_DIFFUSE) g.radial /= s.nu;
    else if (gradient == (int)SPH_GRADIENT_SHEPARD_FULL) g.radial *= (SPH_R(1) - v.w * V_j / s.nu) / s.nu;
    return g;
}
/* g itself, and t = e . g / |e|^2 (for coincident particles its radial part). */
SPH_FN sph_vec sph_elliptic_gradient_vector(int dim, int gradient, sph_vec e, sph_kernel_gradient g)
{
    sph_vec v = sph_scale(g.radial, e);
    if (gradient == (int)SPH_GRADIENT_FULL) {
        v.x += g.rest.x;
        if (dim > 1) v.y += g.rest.y;
        if (dim > 2) v.z += g.rest.z;
    }
    return v;
}
SPH_FN sph_real sph_elliptic_projection(int dim, int gradient, sph_vec e, sph_kernel_gradient g)
{
    return gradient == (int)SPH_GRADIENT_FULL
               ? g.radial + sphi_over_q(sph_dot(dim, e, g.rest), sph_dot(dim, e, e))
               : g.radial;
}

/* Twice the mean of the mobilities, mu_ij. upstream: potential_i - potential_j, for SPH_MOBILITY_UPWIND only.
   */
SPH_FN sph_real sph_mobility_pair(int mean, sph_real m_i, sph_real m_j, sph_real upstream)
{
    if (mean == (int)SPH_MOBILITY_HARMONIC) return SPH_R(4) * m_i * (m_j / (m_i + m_j + SPHI_TINY));
    if (mean == (int)SPH_MOBILITY_UPWIND) return SPH_R(2) * (upstream >= SPH_R(0) ? m_i : m_j);
    return m_i + m_j;
}

typedef struct sph_elliptic_correction {
    sph_real scale;
    sph_vec xi;
} sph_elliptic_correction;

/* T_ij without the mobility: what the weight is for mu = 1. For radial gradients scale V_j t (1 - xi . e). */
SPH_FN sph_real sph_elliptic_weight(int dim, int gradient, sph_vec e, sph_kernel_gradient g,
                                    sph_elliptic_correction c, sph_real V_j)
{
    const sph_real t = sph_elliptic_projection(dim, gradient, e, g);
    if (gradient != (int)SPH_GRADIENT_FULL) return c.scale * V_j * t * (SPH_R(1) - sph_dot(dim, c.xi, e));
    return c.scale * V_j * (t - sph_dot(dim, c.xi, sph_elliptic_gradient_vector(dim, gradient, e, g)));
}

/* The moments of a particle. K is kept by rows: kx = sum V e_x g. */
typedef struct sph_elliptic_moments {
    sph_sym gamma;
    sph_vec n, n_tilde, kx, ky, kz;
} sph_elliptic_moments;

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

/* K^-1, by rows */
typedef struct sph_elliptic_inverse {
    sph_vec x, y, z;
} sph_elliptic_inverse;
SPH_FN sph_vec sph_elliptic_inverse_times(int dim, sph_elliptic_inverse a, sph_vec v)
{
    sph_vec u;
    u.x = sph_dot(dim, a.x, v);
    u.y = dim > 1 ? sph_dot(dim, a.y, v) : SPH_R(0);
    u.z = dim > 2 ? sph_dot(dim, a.z, v) : SPH_R(0);
    return u;
}
/* Returns SPH_OK or SPH_SINGULAR (nothing written). *conditioning: smallest pivot in [0, 1]. */
SPH_FN int sph_elliptic_invert(int dim, int gradient, const sph_elliptic_moments *m, sph_elliptic_inverse *a,
                               sph_real *conditioning)
{
    if (gradient ==
        (int)SPH_GRADIENT_FULL) { /* not symmetric; its entries are of order one, because nu normalises it */
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
        a->x.x = s.xx;
        a->x.y = a->y.x = s.xy;
        a->x.z = a->z.x = s.xz;
        a->y.y = s.yy;
        a->y.z = a->z.y = s.yz;
        a->z.z = s.zz;
    }
    return SPH_OK;
}

/* Eigenvalues of a symmetric tensor, ascending (those beyond dim are 0): Jacobi's rotations, to round-off of
   the largest. */
SPH_FN sph_vec sph_sym_eigenvalues(int dim, sph_sym s)
{
    sph_real a[3][3], t;
    sph_vec v;
    int sweep, p, q, r;
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
                r = 3 - p - q; /* the axis that is not turned */
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

/* What the elliptic sweeps may be told. Zeros are the defaults: gradient (15), arithmetic means, Gamma. */
typedef struct sph_elliptic_options {
    int gradient;   /* an sph_elliptic_gradient */
    int mean;       /* an sph_mobility_mean */
    int gamma_star; /* M-SPH only, 1: Gamma* (71) where it is definite, else Gamma and SPH_FELL_BACK */
    /* Schwaiger, M-SPH, 1: scale = dim / tr Gamma* where that is sound, else SPH_FELL_BACK; see
       sph_elliptic_msph */
    int trace;
    sph_real conditioning_min; /* below: SPH_ILL_CONDITIONED, but computed */
    sph_scalars potential;     /* for SPH_MOBILITY_UPWIND */
    sph_scalars source;        /* added to the result, unless there is none (rows are without) */
} sph_elliptic_options;

/* Gamma* counts as definite if its smallest eigenvalue (for options.trace: its trace) is at least this much
   of Gamma's. At boundaries it often is not, and nearly singular, where its trace of the inverse would be
   huge. */
#define SPHI_GAMMA_STAR_MIN SPH_R(0.1)

/* h_ij = (h_i + h_j) / 2; one h for all costs nothing */
SPH_FN sph_real sphi_mean_h(int uniform, sph_scalars h, sph_real h_i, sph_index j)
{
    return uniform ? h_i : SPH_R(0.5) * (h_i + sphi_at(h, j));
}

/* What the loops over the neighbours of one particle share. */
typedef struct sphi_elliptic {
    sph_cloud cloud;
    sph_scalars m;
    sph_elliptic_options options;
    int uniform;
} sphi_elliptic;

SPH_FN int sphi_elliptic_check(sph_kernel k, int dim, const sphi_elliptic *a)
{
    const sph_elliptic_options o = a->options;
    int error = sphi_check_sweep(k, dim, a->cloud, "volume", a->cloud.volume);
    if (!error && (o.gradient < 0 || o.gradient > (int)SPH_GRADIENT_SHEPARD_FULL))
        error = sphi_refuse("options.gradient", -1, SPH_ERROR_VALUE);
    if (!error && (o.mean < 0 || o.mean > (int)SPH_MOBILITY_UPWIND))
        error = sphi_refuse("options.mean", -1, SPH_ERROR_VALUE);
    if (!error && !sphi_finite(o.conditioning_min))
        error = sphi_refuse("options.conditioning_min", -1, SPH_ERROR_VALUE);
    if (!error) error = sphi_check_not_negative("m", a->m, a->cloud.points.n);
    if (!error && o.mean == (int)SPH_MOBILITY_UPWIND)
        error = sphi_check_field("options.potential", o.potential, a->cloud.points.n);
    return error;
}

/* nu and its gradient; not needed, and 1 and 0, for the gradient (15) */
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
        SPH_SUM(nu, sx, sy, sz)
        for (p = a->cloud.list.start[i]; p < a->cloud.list.start[i + 1]; p++) {
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
    s.nu = nu;
    s.gradient.x = sx;
    s.gradient.y = sy;
    s.gradient.z = sz;
    return s;
}

/* the pair i, j of the list */
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
    c.g = sph_elliptic_gradient_pair(
        a->options.gradient,
        sph_kernel_wf(k, dim, sph_length(dim, c.e), sphi_mean_h(a->uniform, a->cloud.h, h_i, j)), c.V_j, s);
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
    SPH_SUM(xx, xy, yy, xz, yz, zz, nx, ny, nz)
    for (p = a->cloud.list.start[i]; p < a->cloud.list.start[i + 1]; p++) {
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
    if (gradient == (int)SPH_GRADIENT_FULL) { /* K and N are sums of their own */
        const sph_real own =
            -sphi_at(a->cloud.volume, i) * sph_kernel_w(k, dim, SPH_R(0), h_i) / (s.nu * s.nu);
        sph_real k0 = SPH_R(0), k1 = SPH_R(0), k2 = SPH_R(0), k3 = SPH_R(0), k4 = SPH_R(0), k5 = SPH_R(0),
                 k6 = SPH_R(0), k7 = SPH_R(0), k8 = SPH_R(0);
        nx = own * s.gradient.x; /* the particle itself: in N only, which is 0 because of it */
        ny = own * s.gradient.y;
        nz = own * s.gradient.z;
        SPH_SUM(k0, k1, k2, k3, k4, k5, k6, k7, k8, nx, ny, nz)
        for (p = a->cloud.list.start[i]; p < a->cloud.list.start[i + 1]; p++) {
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

/* Gamma* = Gamma - sum V_j (xi . g) e e^T, (71) */
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

enum { SPHI_ELLIPTIC_BROOKSHAW, SPHI_ELLIPTIC_CORRECTED, SPHI_ELLIPTIC_SCHWAIGER, SPHI_ELLIPTIC_MSPH };

/* scale and xi of a particle; SPH_TOO_FEW and SPH_SINGULAR leave them 0. And its moments, but for Brookshaw's
   scheme, which has none. */
SPH_FN int sphi_elliptic_correct(int scheme, sph_kernel k, int dim, const sphi_elliptic *a, sph_shepard s,
                                 sph_index i, sph_elliptic_correction *c, sph_elliptic_moments *m,
                                 sph_real *conditioning)
{
    sph_elliptic_inverse inverse;
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
        c->xi =
            sph_elliptic_inverse_times(dim, inverse, scheme == SPHI_ELLIPTIC_SCHWAIGER ? m->n : m->n_tilde);
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

SPH_FN int sphi_unanswered(int state)
{
    return state == SPH_TOO_FEW || state == SPH_SINGULAR || state == SPH_NOT_AVAILABLE ||
           state == SPH_NOT_FINITE;
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
        SPH_SUM(sum)
        for (p = a->cloud.list.start[i]; p < a->cloud.list.start[i + 1]; p++) {
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
        SPH_EACH
        for (p = a->cloud.list.start[i]; p < a->cloud.list.start[i + 1]; p++) {
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
    return a;
}
/* u and out, or rows; with one body for one h for all, and one for h of each particle's own */
SPH_FN sph_index sphi_elliptic_sweep(int scheme, sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                     sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    const sphi_elliptic one = sphi_elliptic_of(cloud, m, options, 1),
                        own = sphi_elliptic_of(cloud, m, options, 0);
    int error = sphi_elliptic_check(k, dim, &own);
    if (!error) error = sphi_check_field("u", u, cloud.points.n);
    if (!error && options.source.p)
        error = sphi_check_field("options.source", options.source, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_elliptic_apply(scheme, k, dim, &own, u, out)
                          : sphi_elliptic_apply(scheme, k, dim, &one, u, out);
}
SPH_FN sph_index sphi_elliptic_rows(int scheme, sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                    sph_elliptic_options options, sph_rows_out out)
{
    const sphi_elliptic one = sphi_elliptic_of(cloud, m, options, 1),
                        own = sphi_elliptic_of(cloud, m, options, 0);
    int error = sphi_elliptic_check(k, dim, &own);
    if (!error && !out.row) error = sphi_refuse("out.row", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_elliptic_row(scheme, k, dim, &own, out)
                          : sphi_elliptic_row(scheme, k, dim, &one, out);
}

/* div(m grad u)_i + source_i, for all four schemes (see the pair tier: formulas, sources, exactness, errors).
   h        one for all, or each particle's own: pairs then use (h_i + h_j) / 2, and lists must hold every j
            within support * (h_i + h_j) / 2 (SPH_MEAN).
   m        mobility (conductivity, permeability, diffusivity), not negative.   options:
            sph_elliptic_defaults(), or change what it returns.
   source   sph_scalars_array(0) for none.   Vector unknowns: rows once, and sph_rows_apply for each
            component.
   Rows:    div(m grad u)_i = diagonal[i] u_i + sum_p row[p] u_j, p along the list; factor[i] = 1.
   trace    in disorder tr Gamma^-1 / dim is not the right factor: tr Gamma tr Gamma^-1 >= dim^2, so that rows
            of Schwaiger's scheme and M-SPH are 0.3 to 0.7 % too large on jittered clouds, at any resolution,
            and solutions with a source do not converge. With options.trace = 1 the factor is dim / tr Gamma*,
            for which sum_j T_ij |e|^2 = 2 dim m where m is constant: exact for |x|^2 at any particle, at no
            cost in signs (a row's weights keep their ratios). This toolkit's;
            examples/papers/elliptic_clouds.c has the orders. Not at most boundary particles, where tr Gamma*
            is small or negative.
   SPH_TOO_FEW, SPH_SINGULAR: not for Brookshaw's scheme; the neighbours lie on a line or in a plane, or are
   too few: output and row are 0. SPH_FELL_BACK: Gamma was taken for Gamma*, which is not definite.
   SPH_ILL_CONDITIONED: computed, with a conditioning (smallest pivot of the scaled Gamma) below
   conditioning_min. Coincident neighbours get the radial weight of r = 0. */
SPH_FN sph_index sph_elliptic_brookshaw(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                        sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_BROOKSHAW, k, dim, cloud, m, options, u, out);
}
SPH_FN sph_index sph_elliptic_brookshaw_corrected(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                                  sph_elliptic_options options, sph_scalars u,
                                                  sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_CORRECTED, k, dim, cloud, m, options, u, out);
}
SPH_FN sph_index sph_elliptic_schwaiger(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                        sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_SCHWAIGER, k, dim, cloud, m, options, u, out);
}
SPH_FN sph_index sph_elliptic_msph(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                   sph_elliptic_options options, sph_scalars u, sph_scalar_out out)
{
    return sphi_elliptic_sweep(SPHI_ELLIPTIC_MSPH, k, dim, cloud, m, options, u, out);
}
SPH_FN sph_index sph_elliptic_rows_brookshaw(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                             sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_BROOKSHAW, k, dim, cloud, m, options, out);
}
SPH_FN sph_index sph_elliptic_rows_brookshaw_corrected(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                                       sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_CORRECTED, k, dim, cloud, m, options, out);
}
SPH_FN sph_index sph_elliptic_rows_schwaiger(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                             sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_SCHWAIGER, k, dim, cloud, m, options, out);
}
SPH_FN sph_index sph_elliptic_rows_msph(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                        sph_elliptic_options options, sph_rows_out out)
{
    return sphi_elliptic_rows(SPHI_ELLIPTIC_MSPH, k, dim, cloud, m, options, out);
}

/* What the neighbourhood of a particle promises, for M-SPH with the gradient of the options; n numbers each,
   a null pointer is not wanted. */
typedef struct sph_elliptic_report {
    /* of T_ij / (scale V_j mu t_ij) = 1 - xi . e over the neighbours: all weights have one sign where both
       have ((92)), and are positive where both are ((93)) */
    SPH_GLOBAL sph_real *sign_least, *sign_most;
    SPH_GLOBAL sph_real *xi; /* |N~ C|, figure 6 of the paper */
    /* largest V_j e . g / dim: the SPH continuity condition (21) asks for at most 1 */
    SPH_GLOBAL sph_real *continuity;
    SPH_GLOBAL sph_real *n, *n_bound; /* |N| and its bound sum V_j |g|, (22): the bound is C / h */
    /* of C^-1 (its symmetric part), near 1 inside, smaller towards a free surface: Marrone et al. 2010, JCP
       229, 3652, with gradient (17) */
    SPH_GLOBAL sph_real *eigenvalue_least;
    SPH_GLOBAL sph_real *eigenvalue_ratio; /* largest / smallest of Gamma; 0 where it has none */
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_elliptic_report;

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
            if (!(SPHI_ABS(t) > SPH_R(0))) continue; /* out of the support */
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

/* -------- a mobility for each axis: div(M grad u), M = diag(M_x, M_y, M_z) */

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
SPH_FN int sphi_check_diagonal(int dim, sph_diagonal mobility, sph_index n)
{
    int error = sphi_check_not_negative("mobility.x", mobility.x, n);
    if (!error && dim > 1) error = sphi_check_not_negative("mobility.y", mobility.y, n);
    if (!error && dim > 2) error = sphi_check_not_negative("mobility.z", mobility.z, n);
    return error;
}

/* Consistent rows of div(M grad u) for a diagonal M on full supports. What (69) gets wrong is the fourth
   moment: sum_j V_j G e_a e_b M_c e_c^2 / |e|^2, G = -F_ij, is not M_a delta_ab. Here M is replaced by S =
   T^-1 M with T_ac = sum V_j G e_a^2 e_c^2 / |e|^2, so that it is:
       row = V_j G sum_c S(M_i + M_j)_c (e_c^2 / |e|^2 - (K^-1 N_c) . e),   N_c = sum V_j G e e_c^2 / |e|^2,
       K = sum V_j G e e^T.
   In the continuum S = ((dim + 2) M - tr M) / 2; with neighbours on the axes only T is diagonal and this is
   M-SPH, as it is for isotropic M where T is isotropic. This form is this toolkit's. Exact for linear fields
   (M constant) at every particle and for xx, yy, zz in the interior of lattices; to O(disorder) elsewhere. S
   may be negative where M_x / M_y is beyond 3 (2D): weights then have both signs, and maximum principles are
   lost. Gradient (15), arithmetic means. SPH_SINGULAR also where T is: fewer directions of neighbours than
   axes. */
SPH_FN sph_index sph_elliptic_rows_anisotropic(sph_kernel k, int dim, sph_cloud cloud, sph_diagonal mobility,
                                               sph_rows_out out)
{
    const sph_elliptic_options options = {0, 0, 0, 0, SPH_R(0), {0, 0}, {0, 0}};
    const sphi_elliptic a = sphi_elliptic_of(cloud, mobility.x, options, cloud.h.stride == 0);
    sph_shepard none;
    sph_index i, p, failed = 0;
    int error = sphi_check_sweep(k, dim, cloud, "volume", cloud.volume);
    if (!error) error = sphi_check_diagonal(dim, mobility, cloud.points.n);
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

/* -------- boundary conditions */

/* alpha u + beta m du/dn at a boundary particle, with the outer normal; both 0: not a boundary particle. */
typedef struct sph_boundary {
    sph_vectors normal;
    sph_scalars alpha, beta;
} sph_boundary;

/* Rows of  alpha_i u_i + beta_i m_i n_i . grad u  for the targets with alpha or beta not 0; the rows of
            others are left as they are: write those of the operator first, then these over
   them. Dirichlet: alpha = 1, beta = 0. Neumann: alpha = 0, beta = 1: the flux into the domain through a
   boundary with the outer normal n, (100) of Lukyanov & Vuik 2020 with the corrected gradient, exact for
   linear fields, error O(h). Robin: both. n need not have unit length. diagonal is needed. A row of
   SPH_TOO_FEW or SPH_SINGULAR is 0, with its diagonal. */
SPH_FN sph_index sph_elliptic_rows_boundary(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m,
                                            sph_elliptic_options options, sph_boundary boundary,
                                            sph_rows_out out)
{
    const sph_vectors normal = boundary.normal;
    const sph_scalars alpha = boundary.alpha, beta = boundary.beta;
    const sphi_elliptic a = sphi_elliptic_of(cloud, m, options, cloud.h.stride == 0);
    sph_index i, p, failed = 0;
    int error = sphi_elliptic_check(k, dim, &a);
    if (!error) error = sphi_check_field("alpha", alpha, cloud.points.n);
    if (!error) error = sphi_check_field("beta", beta, cloud.points.n);
    if (!error) error = sphi_check_vectors("normal", dim, normal, cloud.points.n);
    if (!error && (!out.row || !out.diagonal))
        error = sphi_refuse("out.row, out.diagonal", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_real alpha_i = sphi_at(alpha, i), beta_i = sphi_at(beta, i), flux = beta_i * sphi_at(m, i),
                       h_i = sphi_at(cloud.h, i);
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        sph_shepard s;
        sph_elliptic_moments moments;
        sph_elliptic_inverse inverse;
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
                n = sph_scale(flux, sph_elliptic_inverse_times(dim, inverse, sphi_vector_at(dim, normal, i)));
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
   Rows of any operator of this file: their use, and what they promise. */

/* the targets, their lists, and that there are rows of numbers; diagonal may be none */
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

/* out_i = sum_p row[p] (u_j - u_i), or, if diagonal is given, diagonal[i] u_i + sum_p row[p] u_j. n: number
   of particles, all sources. The first is exact for constants. */
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
        SPH_SUM(sum)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++)
            sum += row[p] * (sphi_at(u, cloud.list.index[p]) - less);
        failed += sphi_store(out, i, sum);
    }
    return failed;
}

/* Is a row that of an M-matrix: no two off-diagonal weights of different sign, the diagonal of the other sign
   and at least as large as their sum? Lukyanov & Vuik 2020, Definition 7, but for the strictness of the
   dominance: rows of an operator have the sum 0. A matrix of such rows, connected, with a Dirichlet row, is
   monotone: no maximum inside. Returns the number of rows that are not; monotone[i] (may be null): 1 or 0.
   Weights below round-off of the row's largest do not count. */
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
        if (most <= noise && least >= -noise) ok = own != SPH_R(0); /* a Dirichlet row of either sign */
        if (monotone) monotone[i] = (unsigned char)ok;
        others += !ok;
    }
    return others;
}

/* The longest stable step of du/dt = L u by explicit Euler steps: *dt = 2 / max_i (|sum_p row| + sum_p |row|)
   (Gershgorin), a bound that holds for sure where all weights of a row have one sign. 1/SPHI_TINY if there is
   nothing to limit it. For a uniform lattice and its 2 dim nearest neighbours it is dx^2 / (2 dim m). Half of
   it keeps maxima from growing. */
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

SPH_FN int sphi_check_coordinate(SPHI_TEXT *name, sph_real x, sph_real length, sph_index i)
{
    if (!SPH_CHECK) return 0;
    if (!sphi_finite(SPH_R(2) * x)) return sphi_refuse(name, i, SPH_ERROR_POSITION);
    if (!(length > SPH_R(0)) || SPHI_ABS(x) <= SPH_R(1048576) * length) return 0;
    return sphi_refuse("points", i, SPH_ERROR_BOX);
}
/* position and box as far as particle i goes */
SPH_FN int sphi_check_one(int dim, sph_points x, sph_index i)
{
    const sph_vec at = sphi_point(dim, x, i);
    int error;
    x.n = 0; /* the lengths alone */
    error = sphi_check_box(dim, x, SPH_R(0), 1);
    if (!error) error = sphi_check_coordinate("x", at.x, x.box.x, i);
    if (!error && dim > 1) error = sphi_check_coordinate("y", at.y, x.box.y, i);
    if (!error && dim > 2) error = sphi_check_coordinate("z", at.z, x.box.z, i);
    return error;
}
/* The growth factor lambda = 1 + tau sum_p row[p] (exp(i k . e) - 1) of the wave k at particle i under u +
   tau L u (von Neumann); |lambda| <= 1 is stable. (83) of Lukyanov & Vuik 2020. */
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
    if (!error)
        error = sphi_check_one(dim, x,
                               i); /* of the positions only those that it needs: it is called for many i */
    if (!error && SPH_CHECK)
        for (p = list.start[i]; !error && p < list.start[i + 1]; p++)
            error = sphi_check_one(dim, x, list.index[p]);
    if (error) return sphi_answer_of(error);
    for (p = list.start[i]; p < list.start[i + 1]; p++) {
        const sph_real phase = SPH_R(0.5) * sph_dot(dim, wave,
                                                    sphi_separation(dim, x, sphi_point(dim, x, list.index[p]),
                                                                    sphi_point(dim, x, i)));
        const sph_real sine = SPHI_SIN(phase);
        a -= SPH_R(2) * row[p] * sine * sine; /* cos - 1, without cancellation */
        b += SPH_R(2) * row[p] * sine * SPHI_COS(phase);
    }
    if (!sphi_finite(a * tau) || !sphi_finite(b * tau)) return 1;
    *re = SPH_R(1) + tau * a;
    *im = tau * b;
    return 0;
}

/* -------- assembly: rows and diagonals into a CSR matrix on the caller's memory */

#if !SPH_OPENCL
/* entries that sph_csr_assemble may need for these targets: those of the rows, and one diagonal each */
SPH_FN int64_t sph_csr_size(sph_cloud cloud)
{
    if (!cloud.list.start || cloud.first < 0 || cloud.last <= cloud.first) return 0;
    return (int64_t)cloud.list.start[cloud.last] - cloud.list.start[cloud.first] + (cloud.last - cloud.first);
}

/* ascending columns; Shell's method, which costs next to nothing for rows that are sorted or nearly so
   (SPH_LIST_SORTED) */
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

/* A matrix in CSR form, on the caller's memory: start has a place for each target and one more, column and
   value have
   `capacity` places. */
typedef struct sph_csr {
    sph_index *start, *column;
    sph_real *value;
    int64_t capacity;
} sph_csr;

/* The matrix of the targets first ... last - 1: row r belongs to target first + r and has the entries
   start[r] ... start[r + 1] - 1, columns ascending, the diagonal always there, weights of a neighbour that a
   list names twice added up. drop_zeros = 1 leaves out off-diagonal entries that are 0 (neighbours out of
   reach, Dirichlet rows); 0 keeps the pattern of the lists. start: last - first + 1 numbers; column, value:
   capacity, at least sph_csr_size. *entries (may be null): how many there are. Returns 0, or
   SPH_ERROR_CAPACITY (nothing written) if capacity is below sph_csr_size, or that beyond the range of
   sph_index. Must not overlap its inputs. */
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
    if (!error && (out.capacity < sph_csr_size(cloud) ||
                   (int64_t)(sph_index)sph_csr_size(cloud) != sph_csr_size(cloud)))
        error = SPH_ERROR_CAPACITY;
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
 * Notation: v_ij = v_i - v_j, vx = v_ij . x_ij (negative for particles that approach), rho density, p
 * pressure, c sound speed, m mass, V = m / rho.
 * Accelerations are  a_i = -sum_j m_j (P_ij + Pi_ij) F_ij x_ij  with a pressure term P_ij and an artificial
 *                    viscosity Pi_ij, both symmetric in i and j: forces are equal and opposite
 * along the line between the particles where F is (one h for both), and momentum and angular momentum are
 * conserved to round-off.
 */

/* One particle of a pair; a formula reads those that it names. mu: dynamic viscosity. */
typedef struct sph_fluid_side {
    sph_real m, rho, p, mu;
} sph_fluid_side;
/* How two particles meet: vx = v_ij . x_ij (negative if they approach), their distance r, the h of the pair,
   and the means of their sound speeds and densities. */
typedef struct sph_encounter {
    sph_real vx, r, h, c, rho;
} sph_encounter;
/* of an artificial viscosity */
typedef struct sph_viscosity_terms {
    sph_real alpha, beta, eta;
} sph_viscosity_terms;
/* density without pressure p0, speed of sound there, exponent, and the pressure at rho0 */
typedef struct sph_tait {
    sph_real rho0, c, gamma, p0;
} sph_tait;

/* P_ij = p_i / rho_i^2 + p_j / rho_j^2: the variational partner of the summation density, (2.3) of Korzilius,
   Schilders & Anthonissen; Monaghan 1992, ARA&A 30, 543, (3.3). Wrong where the density jumps: it then
   differs from particle to particle of one pressure. */
SPH_FN sph_real sph_pressure_pair_monaghan(sph_fluid_side i, sph_fluid_side j)
{
    return i.p / (i.rho * i.rho) + j.p / (j.rho * j.rho);
}
/* P_ij = (p_i + p_j) / (rho_i rho_j): the partner of the continuity equation in volumes (5.23), (5.24) there;
   Colagrossi & Landrini 2003, JCP 191, 448. Takes density jumps. */
SPH_FN sph_real sph_pressure_pair_colagrossi(sph_fluid_side i, sph_fluid_side j)
{
    return (i.p + j.p) / (i.rho * j.rho);
}
/* P_ij = (V_i^2 p_i + V_j^2 p_j) / (m_i m_j), V = m / rho: the partner of rho_i = m_i sum_j W_ij
   (sph_density_number). Hu & Adams 2006, JCP 213, 844, (16). Takes density jumps. */
SPH_FN sph_real sph_pressure_pair_hu_adams(sph_fluid_side i, sph_fluid_side j)
{
    return i.m / j.m * i.p / (i.rho * i.rho) + j.m / i.m * j.p / (j.rho * j.rho);
}

/* Artificial viscosity Pi_ij >= 0, for particles that approach only: (-alpha c mu + beta mu^2) / rho with mu
   = h vx / (r^2 + eta^2 h^2), and means of c and rho. Monaghan & Gingold 1983, JCP 52, 374; Monaghan 1992,
   (4.1), (4.2). eta^2 = 0.01 is usual. A pair at one point feels nothing. Linear term: a kinematic shear
   viscosity of about alpha h c / (2 (dim + 2)) where all pairs count. */
SPH_FN sph_real sph_viscosity_pair_monaghan(sph_viscosity_terms terms, sph_encounter e)
{
    const sph_real mu = e.h * SPH_R(0.5) * (e.vx - SPHI_ABS(e.vx)) /
                        (e.r * e.r + terms.eta * terms.eta * e.h * e.h + SPHI_TINY);
    return (terms.beta * mu - terms.alpha * e.c) * mu / e.rho;
}
/* The linear term for particles that recede, too: a Navier-Stokes viscosity (shear and bulk). It may be
   negative. Monaghan 2005, Rep. Prog. Phys. 68, 1703, section 4. */
SPH_FN sph_real sph_viscosity_pair_linear(sph_viscosity_terms terms, sph_encounter e)
{
    return -terms.alpha * e.c * e.h * e.vx /
           ((e.r * e.r + terms.eta * terms.eta * e.h * e.h + SPHI_TINY) * e.rho);
}
/* The speed at which two particles see each other: v_sig = (c_i + c_j + beta |w|) / 2, w = v_ij . x_ij / r; c
   is the speed of sound or, of a magnetised gas, sph_mhd_fast_speed. Monaghan 1997, JCP 136, 298; Price 2012,
   JCP 231, 759, (105). */
SPH_FN sph_real sph_signal_speed(sph_real c_i, sph_real c_j, sph_real beta_w)
{
    return SPH_R(0.5) * (c_i + c_j + beta_w);
}
/* Pi_ij = alpha v_sig |w| / rho where particles approach (w < 0), else 0; alpha_speed = alpha v_sig. */
SPH_FN sph_real sph_viscosity_signal(sph_real alpha_speed, sph_real w, sph_real per_rho)
{
    return SPH_R(0.5) * alpha_speed * (SPHI_ABS(w) - w) * per_rho;
}
/* By the speed at which the two particles see each other's signal: -alpha/2 v_sig w / rho, w = min(vx, 0) /
   r, v_sig = c_i + c_j - beta w. Monaghan 1997, JCP 136, 298, (4.13) with K = alpha/2; beta = 3 there.
   Independent of h. */
SPH_FN sph_real sph_viscosity_pair_signal(sph_viscosity_terms terms, sph_encounter e)
{
    const sph_real w = e.vx / (e.r + SPHI_TINY), speed = sph_signal_speed(e.c, e.c, terms.beta * SPHI_ABS(w));
    return sph_viscosity_signal(terms.alpha * speed, w, SPH_R(1) / e.rho);
}

/* Physical viscosity with the dynamic viscosities mu_i, mu_j (mu = nu rho). Morris: the coefficient B of a_i
   = sum_j m_j B v_ij, B = (mu_i + mu_j) / (rho_i rho_j) F r^2 / (r^2 + eta^2 h^2) <= 0: exact for linear
   velocities in the interior, conserves momentum but not angular momentum. Morris, Fox & Zhu 1997, JCP 136,
   214, (22). */
SPH_FN sph_real sph_viscosity_mu_pair_morris(sph_fluid_side i, sph_fluid_side j, sph_encounter e,
                                             sph_real f_ij, sph_real eta)
{
    return (i.mu + j.mu) / (i.rho * j.rho) * f_ij *
           (e.r * e.r / (e.r * e.r + eta * eta * e.h * e.h + SPHI_TINY));
}
/* Monaghan & Cleary: the coefficient B of a_i = sum_j m_j B x_ij, B = 2 (dim + 2) 2 mu_i mu_j / (mu_i + mu_j)
   / (rho_i rho_j) vx / (r^2 + eta^2 h^2) F: along the line between the particles, so that angular momentum is
   conserved, too; takes jumps of mu. Cleary & Monaghan 1999, JCP 148, 227; Monaghan 2005, (4.13); the factor
   2 (dim + 2) makes it div(mu grad v) for incompressible flow. */
SPH_FN sph_real sph_viscosity_mu_pair_monaghan_cleary(int dim, sph_fluid_side i, sph_fluid_side j,
                                                      sph_encounter e, sph_real f_ij, sph_real eta)
{
    return SPH_R(4 * (dim + 2)) * i.mu * (j.mu / (i.mu + j.mu + SPHI_TINY)) / (i.rho * j.rho) * e.vx /
           (e.r * e.r + eta * eta * e.h * e.h + SPHI_TINY) * f_ij;
}

/* F of a pair, but 0 for particles that coincide (closer than 1e-12 h): a direction that is made of rounding
   errors is none. Written with a sign, because a comparison would keep loops from vectorising. */
SPH_FN sph_real sph_kernel_f_apart(sph_kernel k, int dim, sph_real r, sph_real h)
{
    return sph_kernel_f(k, dim, r, h) * (SPH_R(0.5) + SPHI_COPYSIGN(SPH_R(0.5), r - SPH_R(1e-12) * h));
}
/* What j adds to the density rate of i: m_j v_ij . grad_i W_ij, the rate of the summation density; vx = v_ij
   . x_ij. (2.2) of Korzilius, Schilders & Anthonissen; Monaghan 1992, (2.16). */
SPH_FN sph_real sph_density_rate_pair_mass(sph_fluid_side j, sph_real vx, sph_real f_ij)
{
    return j.m * vx * f_ij;
}
/* The same in volumes, for density jumps: rho_i (m_j / rho_j) v_ij . grad_i W_ij. (5.23) there. */
SPH_FN sph_real sph_density_rate_pair_volume(sph_fluid_side i, sph_fluid_side j, sph_real vx, sph_real f_ij)
{
    return j.m * i.rho / j.rho * vx * f_ij;
}

/* What j adds to i in all: acceleration, rate of density, and viscous heating per mass. */
typedef struct sph_fluid_change {
    sph_vec acceleration;
    sph_real rate, heating;
} sph_fluid_change;

/* acceleration -m_j (P_ij + Pi_ij) F x_ij, heating m_j Pi_ij v_ij . x_ij F / 2; push = P_ij + Pi_ij */
SPH_FN sph_fluid_change sphi_fluid_change(sph_real m_j, sph_real push, sph_real viscosity, sph_vec x_ij,
                                          sph_real vx, sph_real f_ij, sph_real rate)
{
    sph_fluid_change c;
    c.acceleration = sph_scale(-(m_j * push * f_ij), x_ij);
    c.rate = rate;
    c.heating = SPH_R(0.5) * viscosity * (m_j * vx * f_ij);
    return c;
}
/* Whole interactions, of which sph_fluid_rates_... are the sums. vx = v_ij . x_ij, f_ij by
   sph_kernel_f_apart, viscosity: Pi_ij, or 0. */
SPH_FN sph_fluid_change sph_fluid_pair_monaghan(sph_fluid_side i, sph_fluid_side j, sph_vec x_ij, sph_real vx,
                                                sph_real f_ij, sph_real viscosity)
{
    return sphi_fluid_change(j.m, sph_pressure_pair_monaghan(i, j) + viscosity, viscosity, x_ij, vx, f_ij,
                             sph_density_rate_pair_mass(j, vx, f_ij));
}
SPH_FN sph_fluid_change sph_fluid_pair_colagrossi(sph_fluid_side i, sph_fluid_side j, sph_vec x_ij,
                                                  sph_real vx, sph_real f_ij, sph_real viscosity)
{
    return sphi_fluid_change(j.m, sph_pressure_pair_colagrossi(i, j) + viscosity, viscosity, x_ij, vx, f_ij,
                             sph_density_rate_pair_volume(i, j, vx, f_ij));
}
SPH_FN sph_fluid_change sph_fluid_pair_hu_adams(sph_fluid_side i, sph_fluid_side j, sph_vec x_ij, sph_real vx,
                                                sph_real f_ij, sph_real viscosity)
{
    return sphi_fluid_change(j.m, sph_pressure_pair_hu_adams(i, j) + viscosity, viscosity, x_ij, vx, f_ij,
                             sph_density_rate_pair_volume(i, j, vx, f_ij));
}

/* XSPH: weight of (v_j - v_i) in what is added to the velocity that moves i, without epsilon: 2 m_j / (rho_i
   + rho_j) W_ij. Monaghan 1989, JCP 82, 1. */
SPH_FN sph_real sph_velocity_pair_xsph(sph_fluid_side i, sph_fluid_side j, sph_real w_ij)
{
    return SPH_R(2) * j.m / (i.rho + j.rho) * w_ij;
}

/* Sums over the fluid in front of a wall particle: W, (p_j + (g - a_w) . rho_j x_wj) W, and v_j W. */
typedef struct sph_wall_sums {
    sph_real weight, p;
    sph_vec v;
} sph_wall_sums;
/* What the fluid particle j adds, x_ij from it to the wall particle, gravity: g - a_w. Adami, Hu & Adams
   2012, JCP 231, 7057, (22), (27). */
SPH_FN sph_wall_sums sph_wall_pair_adami(int dim, sph_fluid_side j, sph_vec v_j, sph_vec x_ij,
                                         sph_vec gravity, sph_real w_ij)
{
    sph_wall_sums c;
    c.weight = w_ij;
    c.p = w_ij * (j.p + j.rho * sph_dot(dim, gravity, x_ij));
    c.v = sph_scale(w_ij, v_j);
    return c;
}
/* The sums over that of W: the pressure of the wall particle, and the velocity of the fluid in front. */
SPH_FN sph_real sph_wall_pressure(sph_wall_sums s) { return s.p / s.weight; }
SPH_FN sph_vec sph_wall_fluid_velocity(sph_wall_sums s)
{
    sph_vec mean;
    mean.x = s.v.x / s.weight;
    mean.y = s.v.y / s.weight;
    mean.z = s.v.z / s.weight;
    return mean;
}
/* Velocity of the wall particle, (23): 2 u - mean (no slip), or mean with its part along the normal turned
   round against the wall's own velocity u (free slip; the normal need not have unit length). */
SPH_FN sph_vec sph_wall_velocity_no_slip(int dim, sph_vec mean, sph_vec wall)
{
    return sph_subtract(dim, sph_scale(SPH_R(2), wall), mean);
}
SPH_FN sph_vec sph_wall_velocity_free_slip(int dim, sph_vec mean, sph_vec wall, sph_vec normal)
{
    const sph_real nn = sph_dot(dim, normal, normal),
                   along = sph_dot(dim, sph_subtract(dim, mean, wall), normal);
    return sph_subtract(dim, mean, sph_scale(nn > SPH_R(0) ? SPH_R(2) * along / nn : SPH_R(0), normal));
}

/* p = p0 + rho0 c^2 / gamma ((rho / rho0)^gamma - 1), its inverse, and the sound speed sqrt(dp/drho): the
   equation of state called after Tait, in Macdonald's form (2.4). gamma = 1: p0 + c^2 (rho - rho0); 7: water.
   p0 is the pressure at rho0, a background where it is not 0. Cole 1948; Macdonald 1966, Rev. Mod. Phys. 38,
   669; Monaghan 1994, JCP 110, 399. The inverse is 0 where no density has that pressure. */
SPH_FN sph_real sph_pressure_tait(sph_real rho, sph_tait t)
{
    const sph_real e = rho / t.rho0, stiffness = t.rho0 * t.c * t.c / t.gamma;
    return t.p0 + stiffness * (t.gamma == SPH_R(1) ? e - SPH_R(1) : SPHI_POW(e, t.gamma) - SPH_R(1));
}
SPH_FN sph_real sph_density_tait(sph_real p, sph_tait t)
{
    const sph_real e = SPH_R(1) + t.gamma * (p - t.p0) / (t.rho0 * t.c * t.c);
    if (!(e > SPH_R(0))) return SPH_R(0);
    return t.rho0 * (t.gamma == SPH_R(1) ? e : SPHI_POW(e, SPH_R(1) / t.gamma));
}
SPH_FN sph_real sph_sound_speed_tait(sph_real rho, sph_tait t)
{
    return t.gamma == SPH_R(1) ? t.c : t.c * SPHI_POW(rho / t.rho0, SPH_R(0.5) * (t.gamma - SPH_R(1)));
}

/* Longest steps of explicit schemes, one particle: sound (Courant), 0.25 h / (c + |v|); force, 0.25 sqrt(h /
   |a|); viscosity, 0.125 h^2 / nu. Monaghan 1992; Morris et al. 1997, (33)-(35). Take the least over all
   particles. What limits nothing gives 1/SPHI_TINY. */
SPH_FN sph_real sphi_limit(sph_real a, sph_real b)
{
    return b > SPHI_TINY * a ? a / b : SPH_R(1) / SPHI_TINY;
}
SPH_FN sph_real sph_time_step_sound(sph_real h, sph_real c, sph_real speed)
{
    return sphi_limit(SPH_R(0.25) * h, c + speed);
}
SPH_FN sph_real sph_time_step_force(sph_real h, sph_real acceleration)
{
    return SPH_R(0.25) * SPHI_SQRT(sphi_limit(h, acceleration));
}
SPH_FN sph_real sph_time_step_viscous_nu(sph_real h, sph_real nu)
{
    return sphi_limit(SPH_R(0.125) * h * h, nu);
}

/* -------- fluid: sweeps */

/* rho_i = m_i sum_j W_ij, the particle itself included: the number density times the own mass, so that a
   light particle beside heavy ones keeps its density. Hu & Adams 2006, JCP 213, 844, (15). m: of the targets.
   V_i = m_i / rho_i is 1 / sum_j W_ij. */
SPH_FN sph_index sph_density_number(sph_kernel k, int dim, sph_cloud cloud, sph_scalars m, sph_scalar_out out)
{
    int error = sphi_check_sweep(k, dim, cloud, "m", m);
    sph_index i, p, failed = 0;
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real sum = sph_kernel_w(k, dim, SPH_R(0), h_i);
        SPH_SUM(sum)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++)
            sum += sph_kernel_w(
                k, dim,
                sph_length(dim, sphi_separation(dim, cloud.points, x_i,
                                                sphi_point(dim, cloud.points, cloud.list.index[p]))),
                h_i);
        failed += sphi_store(out, i, sphi_at(m, i) * sum);
    }
    return failed;
}

typedef enum sph_viscosity {
    SPH_VISCOSITY_NONE,
    SPH_VISCOSITY_MONAGHAN, /* sph_viscosity_pair_monaghan: approaching pairs */
    SPH_VISCOSITY_LINEAR,   /* sph_viscosity_pair_linear: all pairs */
    SPH_VISCOSITY_SIGNAL    /* sph_viscosity_pair_signal: by signal speed */
} sph_viscosity;

/* What moves a fluid; n numbers each, all sources. One h for a pair, (h_i + h_j) / 2: lists by SPH_MEAN, or
   by any criterion where h is one for all. */
typedef struct sph_fluid {
    sph_scalars m, rho, p, c; /* c is read for artificial viscosity only */
    sph_vectors v;
    int viscosity; /* an sph_viscosity */
    sph_real alpha, beta;
    sph_real eta; /* softens r^2 to r^2 + eta^2 h^2 in viscosities; 0: 0.1, the usual one; negative: not */
} sph_fluid;

/* Where rates go; rate, heating and status may be null. The stride is that of rate and heating. */
typedef struct sph_fluid_out {
    sph_vector_out acceleration;
    SPH_GLOBAL sph_real *rate, *heating; /* of density, and of the thermal energy per mass by viscosity */
    size_t stride;
    SPH_GLOBAL unsigned char *status;
} sph_fluid_out;

enum { SPHI_MONAGHAN, SPHI_COLAGROSSI, SPHI_HU_ADAMS };
SPH_FN sph_real sphi_softening(sph_real eta)
{
    return eta == SPH_R(0) ? SPH_R(0.1) : eta < SPH_R(0) ? SPH_R(0) : eta;
}
/* The values of particle i; those that a sweep does not read are 0. */
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
        SPH_SUM(ax, ay, az, rate, heating)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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
    if (!error && f.viscosity != (int)SPH_VISCOSITY_NONE) error = sphi_check_field("c", f.c, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, f.v, cloud.points.n);
    if (!error) error = sphi_check_out("out.acceleration", dim, out.acceleration);
    if (error) return sphi_answer_of(error);
    return cloud.h.stride ? sphi_fluid_range(form, 0, k, dim, cloud, &f, out)
                          : sphi_fluid_range(form, 1, k, dim, cloud, &f, out);
}

/* Acceleration, density rate and viscous heating of the targets, in one pass:
       a_i = -sum_j m_j (P_ij + Pi_ij) grad_i W_ij,   the rate of density that belongs to it,   du_i/dt =
       sum_j m_j Pi_ij v_ij . grad_i W_ij / 2.
   monaghan: (2.2), (2.3) of Korzilius, Schilders & Anthonissen; drho_i/dt = sum_j m_j v_ij . grad W.
   colagrossi: (5.23), (5.24); drho_i/dt = rho_i sum_j m_j/rho_j v_ij . grad W. hu_adams: volume-weighted;
   with sph_density_number, or the rate of (5.23).
   Signs: F <= 0, so pressure pushes apart; no gravity. rate, heating may be null. Pairs closer than 1e-12 h
   exert no force on each other (sph_coincident_count finds them). Errors as of all sweeps, and
   SPH_ERROR_VALUE for densities or masses that are not positive. */
SPH_FN sph_index sph_fluid_rates_monaghan(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                          sph_fluid_out out)
{
    return sphi_fluid_rates(SPHI_MONAGHAN, k, dim, cloud, fluid, out);
}
SPH_FN sph_index sph_fluid_rates_colagrossi(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                            sph_fluid_out out)
{
    return sphi_fluid_rates(SPHI_COLAGROSSI, k, dim, cloud, fluid, out);
}
SPH_FN sph_index sph_fluid_rates_hu_adams(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                          sph_fluid_out out)
{
    return sphi_fluid_rates(SPHI_HU_ADAMS, k, dim, cloud, fluid, out);
}

enum { SPHI_MORRIS, SPHI_MONAGHAN_CLEARY };
SPH_FN sph_index sphi_viscous(int form, sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                              sph_scalars mu, sph_vector_out a)
{
    const sph_scalars m = fluid.m, rho = fluid.rho;
    const sph_vectors v = fluid.v;
    const sph_real eta = sphi_softening(fluid.eta);
    int error = sphi_check_sweep(k, dim, cloud, "m", m);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_positive("rho", rho, cloud.points.n);
    if (!error) error = sphi_check_field("mu", mu, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", dim, v, cloud.points.n);
    if (!error) error = sphi_check_out("a", dim, a);
    if (!error && !sphi_finite(fluid.eta)) error = sphi_refuse("fluid.eta", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), v_i = sphi_vector_at(dim, v, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        const sph_fluid_side own = sphi_fluid_side(SPHI_READ_RHO + SPHI_READ_MU, &fluid, mu, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0);
        sph_vec sum;
        SPH_SUM(ax, ay, az)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          v_ij = sph_subtract(dim, v_i, sphi_vector_at(dim, v, j));
            const sph_real r = sph_length(dim, x_ij), h_ij = SPH_R(0.5) * (h_i + sphi_at(cloud.h, j)),
                           f_ij = sph_kernel_f(k, dim, r, h_ij), m_j = sphi_at(m, j);
            const sph_fluid_side other = sphi_fluid_side(SPHI_READ_RHO + SPHI_READ_MU, &fluid, mu, j);
            sph_encounter e;
            sph_real b;
            sph_vec along;
            e.c = e.rho = SPH_R(0);
            e.vx = sph_dot(dim, v_ij, x_ij);
            e.r = r;
            e.h = h_ij;
            b = m_j * (form == SPHI_MORRIS
                           ? sph_viscosity_mu_pair_morris(own, other, e, f_ij, eta)
                           : sph_viscosity_mu_pair_monaghan_cleary(dim, own, other, e, f_ij, eta));
            along = form == SPHI_MORRIS ? v_ij : x_ij;
            ax += b * along.x;
            if (dim > 1) ay += b * along.y;
            if (dim > 2) az += b * along.z;
        }
        sum.x = ax;
        sum.y = ay;
        sum.z = az;
        failed += sphi_store_vector(dim, a, i, sum);
    }
    return failed;
}
/* a_i = (1 / rho) div(mu grad v) by physical viscosity, mu (dynamic, = nu rho) of each particle; see the pair
   tier for the two forms. */
SPH_FN sph_index sph_viscosity_mu_morris(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                         sph_scalars mu, sph_vector_out acceleration)
{
    return sphi_viscous(SPHI_MORRIS, k, dim, cloud, fluid, mu, acceleration);
}
SPH_FN sph_index sph_viscosity_mu_monaghan_cleary(sph_kernel k, int dim, sph_cloud cloud, sph_fluid fluid,
                                                  sph_scalars mu, sph_vector_out acceleration)
{
    return sphi_viscous(SPHI_MONAGHAN_CLEARY, k, dim, cloud, fluid, mu, acceleration);
}

/* What XSPH adds to the velocity that moves a particle: epsilon sum_j 2 m_j / (rho_i + rho_j) (v_j - v_i)
   W_ij. Monaghan 1989, JCP 82, 1. epsilon = 0.5 is usual. Keeps linear and angular momentum. */
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
        SPH_SUM(ax, ay, az)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sph_vec v_ij = sph_subtract(dim, v_i, sphi_vector_at(dim, v, j));
            const sph_real r =
                sph_length(dim, sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)));
            const sph_real w_ij = sph_kernel_w(k, dim, r, SPH_R(0.5) * (h_i + sphi_at(cloud.h, j))),
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

/* share: 1 for fluid particles, 0 for all others. velocity: of the wall itself. gravity: less the wall's
   acceleration. normal: of the wall, for free slip; null: no slip. */
typedef struct sph_wall {
    sph_scalars share, rho, p;
    sph_vectors v, velocity, normal;
    sph_vec gravity;
} sph_wall;
typedef struct sph_wall_out {
    SPH_GLOBAL sph_real *p;
    sph_vector_out v;
    size_t stride;                    /* of p */
    SPH_GLOBAL unsigned char *status; /* may be null */
} sph_wall_out;

/* Pressure and velocity of wall particles from the fluid in front of them, so that walls push and drag as a
   fluid would: over the neighbours j of a wall particle w that are fluid (share[j] = 1, walls 0)
       p_w = (sum p_j W + (g - a_w) . sum rho_j x_wj W) / sum W,   v_w = 2 u_w - sum v_j W / sum W (no-slip;
       free slip: only the part along the normal is turned round),
   u_w, a_w: the wall's own velocity and acceleration. Adami, Hu & Adams 2012, JCP 231, 7057, (22), (23),
   (27). normal (may have null arrays): free slip. Without fluid in reach: p = 0, v = u, SPH_TOO_FEW, and the
   particle pushes nobody. status may be null. */
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
    if (!error) error = sphi_check_vectors("velocity", dim, wall_velocity, cloud.points.n);
    if (!error && free_slip) error = sphi_check_vectors("normal", dim, normal, cloud.points.n);
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
        SPH_SUM(weight, pressure, vx, vy, vz)
        for (q = cloud.list.start[i]; q < cloud.list.start[i + 1]; q++) {
            const sph_index j = cloud.list.index[q];
            const sph_vec x_ij = sphi_separation(dim, cloud.points, x_i, sphi_point(dim, cloud.points, j)),
                          v_j = sphi_vector_at(dim, v, j);
            const sph_real w = sphi_at(share, j) * sph_kernel_w(k, dim, sph_length(dim, x_ij),
                                                                SPH_R(0.5) * (h_i + sphi_at(cloud.h, j)));
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

/* ================================================================ collisions
 *
 * Two particles that are closer than a collision distance exchange an impulse along the line between them, as
 * two balls of restitution C_R do: 0 inelastic, 1 elastic. Korzilius, Schilders & Anthonissen, section IV. In
 * inverse masses w = 1/m, so that a wall is w = 0: the velocity of i changes by
 *     dv_i = -(1 + C_R) w_i / (w_i + w_j) (v_ij . e) e,   e = x_ij / r,
 * and m_i dv_i = -m_j dv_j: momentum and angular momentum are kept exactly, a single pair loses mu (1 -
 * C_R^2) (v_ij . e)^2 / 2, mu = 1 / (w_i + w_j). (4.20) there sums this over all pairs at once, receding
 * ones, too: particles then stick and energy grows without bounds (tests/test_collisions.c). Only approaching
 * pairs collide here, one after the other (sequential) or at once with the weight 1 / max(n_i, n_j), n:
 * number of collisions of a particle; both never gain energy for C_R <= 1.
 */

/* Inverse masses (0: a wall), vx = v_ij . x_ij < 0, and the square of the distance. */
typedef struct sph_impact {
    sph_real w_i, w_j, vx, r2;
} sph_impact;

/* dv_i = coefficient x_ij: -(1 + C_R) w_i / (w_i + w_j) vx / r^2. Undefined at r = 0 and for two walls. */
SPH_FN sph_real sph_collision_pair(sph_real restitution, sph_impact c)
{
    return -(SPH_R(1) + restitution) * (c.w_i / (c.w_i + c.w_j)) * c.vx / c.r2;
}

/* -------- collisions: sweeps */

/* What collides: positions, lists that reach as far as the collision distance (rows for the targets; walls
   may be sources only), inverse masses (0: a wall), velocities. */
/* Particles nearer than `distance` that approach collide. inverse_mass: 0 for walls. restitution: 0 plastic,
   1 elastic. */
typedef struct sph_collision {
    sph_real distance, restitution;
    sph_scalars inverse_mass;
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
/* Do these two collide? 0 no, 1 yes, -1 they coincide (closer than 1e-12 of the distance): no direction. */
SPH_FN int sphi_collides(sph_real r2, sph_real distance, sph_real vx)
{
    if (!(r2 < distance * distance)) return 0;
    if (!(r2 > SPH_R(1e-24) * distance * distance)) return -1;
    return vx < SPH_R(0);
}

#if !SPH_OPENCL
typedef struct sph_collision_report {
    int64_t collisions, coincident; /* pairs; coincident ones exchange nothing */
    sph_real energy; /* change of the kinetic energy, <= 0 for restitution <= 1 (walls have none) */
} sph_collision_report;

/* Collisions one after the other, in the order of rows and lists, each with the velocities that the one
   before left: changes v (stride as given) of sources, too, if they are not walls; the one sweep that writes
   beyond its targets, so never on two ranges at once. Each pair once, also if both rows name it. Momentum and
   angular momentum to round-off; energy never grows for restitution <= 1. Returns 0, the number of pairs
   whose velocities or energy would overflow (they exchange nothing), or an error; out may be null. */
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
            if (j < i && j >= cloud.first) continue; /* its own row has had it */
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

/* How many collisions each target is in: the first half of the simultaneous form. Full lists. Returns how
   many targets coincide with a neighbour (they do not collide with it), or an error. A host with halo
   particles exchanges the counts before the second half. */
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
   n_j); count: from sph_collision_count, for the targets and the sources that are no walls. Full lists;
   order-independent, any ranges in parallel; momentum and angular momentum to round-off, and energy never
   grows for restitution <= 1 (a particle in n > 1 collisions loses some also at 1). The host adds it to v. */
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
            n_i = w_i > SPH_R(0) ? count[i] : 1; /* a wall takes any number of impulses, whatever its count */
            n_j = w_j > SPH_R(0) ? count[j] : 1;
            c = sph_collision_pair(restitution, sphi_impact(w_i, w_j, vx, r2));
            c /= (sph_real)(n_i > n_j ? n_i : n_j > 1 ? n_j : 1);
            sum = sph_subtract(dim, sum, sph_scale(-c, x_ij));
        }
        failed += sphi_store_vector(dim, change, i, sum);
    }
    return failed;
}

/* ================================================================ magnetohydrodynamics and divergence
 * cleaning
 *
 * Units with mu_0 = 1 (divide B of other units by sqrt(mu_0)). With grad_i W_ij = F x_ij, F_i = F(r, h_i),
 * and the factors
 *     g_i = F_i / (Omega_i rho_i^2),   g_j = F_j / (Omega_j rho_j^2),   G = (F_i / Omega_i + F_j / Omega_j) /
 *     2.
 * Tricco & Price 2012, 7th SPHERIC workshop, equations in brackets; J. Comput. Phys. 231, 7214. Price 2012,
 * JCP 231, 759 (SPMHD as a whole). Conjugate operators: the difference form of div and the symmetric form of
 * grad are adjoint, sum V psi (div B) = -sum V B . (grad psi) with V = m / rho, for any B and psi, also with
 * an h of each particle's own. So what the cleaning wave takes from the magnetic energy it gives to that of
 * psi, sum m psi^2 / (2 rho ch^2), and back: (2), (12), (23). Damping only takes. The pair of difference
 * forms has no such balance: at edges and density jumps energy grows without bounds (tests/test_cleaning.c);
 * examples/papers/cleaning_forms.h has it, to compare with. Misprints that are corrected here: (6)
 * has grad_b in its second term, for grad_a; (8) has + B^2/2 for -(P + B^2/2); (10) needs the square of the
 * mean density; (28) a plus sign; (38) a minus sign.
 */

/* (M_i . x_ij) of the Maxwell stress M = B B - (P + B^2/2) 1. Force of a pair, (6): m_j (M_i . x_ij g_i + M_j
   . x_ij g_j). */
SPH_FN sph_vec sph_mhd_traction(sph_vec field, sph_real pressure, sph_real Bx, sph_vec x_ij)
{
    const sph_real p = pressure + SPH_R(0.5) * sph_dot(3, field, field);
    sph_vec t;
    t.x = field.x * Bx - p * x_ij.x;
    t.y = field.y * Bx - p * x_ij.y;
    t.z = field.z * Bx - p * x_ij.z;
    return t;
}
/* the same from squares: of the speed of sound, of the Alfven speed and of its part along the pair */
SPH_FN sph_real sphi_fast_speed(sph_real sound2, sph_real alfven2, sph_real along2)
{
    const sph_real s = sound2 + alfven2, d = s * s - SPH_R(4) * sound2 * along2;
    return SPHI_SQRT(SPH_R(0.5) * (s + SPHI_SQRT(SPH_R(0.5) * (d + SPHI_ABS(d)))));
}
/* The fast magnetosonic speed along the pair: v^2 = (cs^2 + vA^2 + sqrt((cs^2 + vA^2)^2 - 4 cs^2 (B . x/r)^2
   / rho)) / 2 */
SPH_FN sph_real sph_mhd_fast_speed(sph_real cs, sph_vec field, sph_real rho, sph_real B_along)
{
    const sph_real per_rho = SPH_R(1) / rho;
    return sphi_fast_speed(cs * cs, sph_dot(3, field, field) * per_rho, B_along * B_along * per_rho);
}
/* Speed of sound along which conductivity equalises: sqrt(|P_i - P_j| / rho), of the mean rho. Price 2008,
   JCP 227, 10040. */
SPH_FN sph_real sph_conductivity_speed(sph_real P_i, sph_real P_j, sph_real per_rho)
{
    return SPHI_SQRT(SPHI_ABS(P_i - P_j) * per_rho);
}

/* speed of the cleaning waves, damping, smoothing length */
typedef struct sph_cleaning_wave {
    sph_real ch, sigma, h;
    SPHI_TCC_PAD
} sph_cleaning_wave;

/* dpsi/dt = -ch^2 div B - sigma ch psi / h - psi div v / 2: (2) with 1/tau = sigma ch / h, (19). sigma: 0.2
   to 0.3 in 2D, 0.8 to 1.2 in 3D (Tricco & Price 2012); see sph_cleaning_sigma. */
SPH_FN sph_real sph_cleaning_rate(sph_cleaning_wave w, sph_real psi, sph_real div_B, sph_real div_v)
{
    return -w.ch * w.ch * div_B - (w.sigma * w.ch / w.h + SPH_R(0.5) * div_v) * psi;
}
/* The same for psi / ch as what evolves, for a ch that changes with time: its energy, sum m (psi/ch)^2 / (2
   rho), then does not. Tricco, Price & Bate 2016, JCP 322, 326. Where grad psi is wanted, psi = ch times it.
   */
SPH_FN sph_real sph_cleaning_rate_scaled(sph_cleaning_wave w, sph_real psi_over_ch, sph_real div_B,
                                         sph_real div_v)
{
    return -w.ch * div_B - (w.sigma * w.ch / w.h + SPH_R(0.5) * div_v) * psi_over_ch;
}
SPH_FN sph_real sph_cleaning_sigma(int dim) { return dim < 3 ? SPH_R(0.3) : SPH_R(1); }
/* Velocity cleaning (29)-(39): psi is a pressure. Accelerations: p + psi for p in sph_fluid_rates_monaghan,
   whose density rate (28) then gives
       dpsi/dt = ch^2 drho/dt - sigma ch psi / h.
   Conserves linear and angular momentum and (rho frozen, undamped) sum m (v^2/2 + psi^2 / (2 ch^2 rho^2)).
   The Courant limit takes sqrt(cs^2 + ch^2). */
SPH_FN sph_real sph_cleaning_rate_velocity(sph_cleaning_wave w, sph_real psi, sph_real density_rate)
{
    return w.ch * w.ch * density_rate - w.sigma * w.ch / w.h * psi;
}

/* B = grad alpha x grad beta (Euler potentials; in 2D alpha = A_z, beta = z: B = (dA/dy, -dA/dx)). Gradients
   by sph_gradient_cspm, exact for linear potentials. Windings beyond one turn cannot be represented. */
SPH_FN sph_vec sph_euler_potentials(sph_vec grad_alpha, sph_vec grad_beta)
{
    sph_vec field;
    field.x = grad_alpha.y * grad_beta.z - grad_alpha.z * grad_beta.y;
    field.y = grad_alpha.z * grad_beta.x - grad_alpha.x * grad_beta.z;
    field.z = grad_alpha.x * grad_beta.y - grad_alpha.y * grad_beta.x;
    return field;
}
/* the value of a switch, and its bounds */
typedef struct sph_switch {
    sph_real alpha, least, most;
} sph_switch;

/* dalpha/dt of the viscosity switch: (alpha_min - alpha) decay + max(-div v, 0) (alpha_max - alpha), decay =
   0.1 v_sig / h. Morris & Monaghan 1997, JCP 136, 41. */
SPH_FN sph_real sph_viscosity_switch_rate(sph_switch s, sph_real v_sig, sph_real h, sph_real div_v)
{
    return (s.least - s.alpha) * SPH_R(0.1) * v_sig / h +
           SPH_R(0.5) * (SPHI_ABS(div_v) - div_v) * (s.most - s.alpha);
}
/* alpha_B / alpha_max = min(1, h change / B): resistivity only where the field changes within h. B = |B|;
   change: |grad B|, the root of the squares of all its components (Tricco & Price 2013, MNRAS 436, 2810, with
   alpha_max = 1), or |curl B|, which leaves the divergence to the cleaning. 0 where nothing changes,
   1 where only B is 0. */
SPH_FN sph_real sph_resistivity_switch(sph_real h, sph_real change, sph_real strength)
{
    return strength > h * change ? h * change / strength : change > SPH_R(0) ? SPH_R(1) : SPH_R(0);
}

/* -------- gradient, divergence and curl of a medium: pair functions */

/* Mass, density and Omega of one particle. */
typedef struct sph_medium_side {
    sph_real m, rho, omega;
    SPHI_TCC_PAD
} sph_medium_side;
/* The kernel between two particles: their distance, and F with the h of either. */
typedef struct sph_pair_kernel {
    sph_real r, f_i, f_j;
    SPHI_TCC_PAD
} sph_pair_kernel;
/* What the symmetric forms weigh the two sides with: m_j g_i and m_j g_j, g = F / (Omega rho^2). */
typedef struct sph_pair_weights {
    sph_real i, j;
} sph_pair_weights;

/* 1 / (Omega rho^2): g is F times this. */
SPH_FN sph_real sph_medium_weight(sph_medium_side a) { return SPH_R(1) / (a.omega * a.rho * a.rho); }
SPH_FN sph_pair_weights sph_pair_weights_of(sph_real m_j, sph_pair_kernel f, sph_real weight_i,
                                            sph_real weight_j)
{
    sph_pair_weights w;
    w.i = m_j * (f.f_i * weight_i);
    w.j = m_j * (f.f_j * weight_j);
    return w;
}

/* Difference forms, exact for constants. weight = m_j F_i; a_ij = A_i - A_j:
       div A_i = sph_medium_difference(i, sum of weight a_ij . x_ij), (20),
       curl A_i = -sph_medium_difference(i, each component of the sum of weight a_ij x x_ij), Price 2012,
       (79). */
SPH_FN sph_real sph_divergence_pair_difference(int dim, sph_real weight, sph_vec a_ij, sph_vec x_ij)
{
    return weight * sph_dot(dim, a_ij, x_ij);
}
SPH_FN sph_vec sph_curl_pair_difference(sph_real weight, sph_vec a_ij, sph_vec x_ij)
{
    const sph_vec d = sph_scale(weight, a_ij);
    sph_vec c;
    c.x = d.y * x_ij.z - d.z * x_ij.y;
    c.y = d.z * x_ij.x - d.x * x_ij.z;
    c.z = d.x * x_ij.y - d.y * x_ij.x;
    return c;
}
SPH_FN sph_real sph_medium_difference(sph_medium_side i, sph_real sum) { return -sum / (i.omega * i.rho); }

/* Symmetric forms, which are rho_i times the sums of these: the conjugates of the difference forms, not 0 for
   constants. div: what (9) subtracts; grad: (23). */
SPH_FN sph_real sph_divergence_pair_symmetric(int dim, sph_pair_weights w, sph_vec a_i, sph_vec a_j,
                                              sph_vec x_ij)
{
    return sph_dot(dim, a_i, x_ij) * w.i + sph_dot(dim, a_j, x_ij) * w.j;
}
SPH_FN sph_vec sph_gradient_pair_symmetric(sph_pair_weights w, sph_real f_i, sph_real f_j, sph_vec x_ij)
{
    return sph_scale(f_i * w.i + f_j * w.j, x_ij);
}

/* -------- magnetohydrodynamics: pair functions */

/* Stretching of the field, (7): weight (B_i . x_ij) v_ij, weight = m_j F_i. With div v in difference form
       dB_i/dt = sph_medium_difference(i, each component of the sum) - B_i div v_i. */
SPH_FN sph_vec sph_induction_pair(sph_real weight, sph_real Bx_i, sph_vec v_ij)
{
    return sph_scale(weight * Bx_i, v_ij);
}
/* Artificial resistivity, (10): dB_i/dt has rho_i sum_j weight B_ij of it, weight = m_j eta G r, eta =
   alpha_B v_sig / rho^2 with the mean density (its square: a misprint of (10)). */
SPH_FN sph_real sph_resistivity_pair(sph_real weight, sph_real alpha_speed, sph_real per_rho)
{
    return weight * alpha_speed * per_rho * per_rho;
}

/* The values of one particle; psi is not read without cleaning. */
typedef struct sph_mhd_side {
    sph_medium_side medium;
    sph_real p, u, cs, alpha, alpha_B, psi;
    sph_vec v, field;
} sph_mhd_side;
/* parts: 3 where v and field have three components, else the dimension. cleans: 1: there is a psi. */
typedef struct sph_mhd_terms {
    sph_real beta, alpha_u;
    int parts, cleans;
} sph_mhd_terms;
/* What j adds to the sums of i, and the sums. */
typedef struct sph_mhd_sums {
    sph_vec force, stretching, cleaning, resistivity;
    sph_real tension, div_v, div_B, heat;
    sph_real speed; /* of signals between the two; of a sum: the largest */
} sph_mhd_sums;

/* The whole interaction: (6), (7), (10), (23), artificial viscosity and conductivity; see sph_mhd_rates. */
SPH_FN sph_mhd_sums sph_mhd_pair(int dim, sph_mhd_terms terms, sph_mhd_side i, sph_mhd_side j,
                                 sph_pair_kernel f, sph_vec x_ij)
{
    /* of either side one division serves rho and Omega */
    const sph_real both_i = SPH_R(1) / (i.medium.omega * i.medium.rho),
                   both_j = SPH_R(1) / (j.medium.omega * j.medium.rho), per_rho_i = i.medium.omega * both_i,
                   per_rho_j = j.medium.omega * both_j, m_j = j.medium.m;
    const sph_pair_weights g = sph_pair_weights_of(m_j, f, per_rho_i * both_i, per_rho_j * both_j);
    const sph_real mean_f =
                       SPH_R(0.5) * m_j * (f.f_i * (i.medium.rho * both_i) + f.f_j * (j.medium.rho * both_j)),
                   weight = m_j * f.f_i, per_rho = SPH_R(2) / (i.medium.rho + j.medium.rho),
                   per_r = SPH_R(1) / (f.r + SPHI_TINY);
    const sph_vec v_ij = sph_subtract(terms.parts, i.v, j.v),
                  B_ij = sph_subtract(terms.parts, i.field, j.field);
    const sph_real Bx_i = sph_dot(dim, i.field, x_ij), Bx_j = sph_dot(dim, j.field, x_ij),
                   vx = sph_dot(dim, v_ij, x_ij), w = vx * per_r, along_i = Bx_i * per_r,
                   along_j = Bx_j * per_r;
    const sph_real speed = sph_signal_speed(
        sphi_fast_speed(i.cs * i.cs, sph_dot(3, i.field, i.field) * per_rho_i, along_i * along_i * per_rho_i),
        sphi_fast_speed(j.cs * j.cs, sph_dot(3, j.field, j.field) * per_rho_j, along_j * along_j * per_rho_j),
        terms.beta * SPHI_ABS(w));
    const sph_real viscosity = sph_viscosity_signal(SPH_R(0.5) * (i.alpha + j.alpha) * speed, w, per_rho),
                   push = viscosity * mean_f, /* times -x_ij */
        resistivity =
            sph_resistivity_pair(mean_f * f.r, SPH_R(0.5) * (i.alpha_B + j.alpha_B) * speed, per_rho),
                   conduction =
                       terms.alpha_u * sph_conductivity_speed(i.p, j.p, per_rho) * (i.u - j.u) * per_rho;
    const sph_vec t_i = sph_mhd_traction(i.field, i.p, Bx_i, x_ij),
                  t_j = sph_mhd_traction(j.field, j.p, Bx_j, x_ij);
    sph_mhd_sums c;
    c.force.x = t_i.x * g.i + t_j.x * g.j - push * x_ij.x;
    c.force.y = t_i.y * g.i + t_j.y * g.j - push * x_ij.y;
    c.force.z = t_i.z * g.i + t_j.z * g.j - push * x_ij.z;
    c.stretching = sph_induction_pair(weight, Bx_i, v_ij);
    c.cleaning = sph_gradient_pair_symmetric(g, terms.cleans ? i.psi : SPH_R(0),
                                             terms.cleans ? j.psi : SPH_R(0), x_ij);
    c.resistivity = sph_scale(resistivity, B_ij);
    c.tension = Bx_i * g.i + Bx_j * g.j;
    c.div_v = weight * vx;
    c.div_B = weight * (Bx_i - Bx_j);
    c.heat = mean_f * f.r * (SPH_R(0.5) * viscosity * w + conduction) -
             SPH_R(0.5) * resistivity * sph_dot(terms.parts, B_ij, B_ij);
    c.speed = speed;
    return c;
}

/* What the sums make: the rates of particle i. tensile: see sph_mhd; wave: ch = 0 without cleaning. */
typedef struct sph_mhd_change {
    sph_vec acceleration, rate_B;
    sph_real rate_u, rate_psi, div_B, div_v;
} sph_mhd_change;
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

/* -------- magnetohydrodynamics and divergence cleaning: sweeps
   Lists of all pairs with r < support * max(h_i, h_j) (SPH_LARGER). rho and Omega: from sph_density_adaptive,
   or any density and sph_scalars_same(&one) for an h that is constant. Vectors may have a third component in
   two dimensions: it is there if its array is. */

/* m, rho, Omega of all sources */
typedef struct sph_medium {
    sph_scalars m, rho, omega;
} sph_medium;

SPH_FN sph_cleaning_wave sphi_cleaning_wave(sph_real ch, sph_real sigma, sph_real h)
{
    sph_cleaning_wave w;
    w.ch = ch;
    w.sigma = sigma;
    w.h = h;
    return w;
}
SPH_FN int sphi_check_medium(sph_kernel k, int dim, sph_cloud cloud, sph_medium g)
{
    int error = sphi_check_sweep(k, dim, cloud, "m", g.m);
    if (!error) error = sphi_check_positive("rho", g.rho, cloud.points.n);
    return error ? error : sphi_check_positive("omega", g.omega, cloud.points.n);
}
/* three components where there are three arrays, else dim */
SPH_FN int sphi_components(int dim, sph_vectors v) { return v.z.p ? 3 : dim; }

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

/* div A_i = -(1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) . grad_i W_ij(h_i): difference form, (20); exact for
   constants, and -(drho/dt) / rho for A = v. */
SPH_FN sph_index sph_divergence_difference(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                           sph_vectors field, sph_scalar_out out)
{
    int error = sphi_check_medium(k, dim, cloud, medium);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("field", dim, field, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), A_i = sphi_vector_at(dim, field, i);
        const sph_real h_i = sphi_at(cloud.h, i);
        sph_real sum = SPH_R(0);
        SPH_SUM(sum)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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
/* div A_i = rho_i sum_j m_j (A_i g_i + A_j g_j) . x_ij: symmetric form; what (9) subtracts. It measures the
   disorder of the particles, too, and is not 0 for constant A. */
SPH_FN sph_index sph_divergence_symmetric(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                          sph_vectors field, sph_scalar_out out)
{
    int error = sphi_check_medium(k, dim, cloud, medium);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("field", dim, field, cloud.points.n);
    if (!error && !out.p) error = sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(dim, cloud.points, i), A_i = sphi_vector_at(dim, field, i);
        const sph_real h_i = sphi_at(cloud.h, i), own = sph_medium_weight(sphi_medium_side(&medium, i));
        sph_real sum = SPH_R(0);
        SPH_SUM(sum)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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
/* grad f_i = rho_i sum_j m_j (f_i g_i + f_j g_j) x_ij: the conjugate of the difference divergence, (23); not
   0 for constant f. */
SPH_FN sph_index sph_gradient_symmetric(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                        sph_scalars f, sph_vector_out out)
{
    int error = sphi_check_medium(k, dim, cloud, medium);
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
        SPH_SUM(sx, sy, sz)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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
/* curl A_i = (1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) x grad_i W_ij(h_i): difference form, three
   components (in 2D of A that has two: the third). Exact for constants. Price 2012, (79). */
SPH_FN sph_index sph_curl_difference(sph_kernel k, int dim, sph_cloud cloud, sph_medium medium,
                                     sph_vectors field, sph_vector_out out)
{
    const int parts = sphi_components(dim, field);
    int error = sphi_check_medium(k, dim, cloud, medium);
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
        SPH_SUM(cx, cy, cz)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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

/* div_v: null: 0. ch: speed of the cleaning waves. sigma: damping, see sph_cleaning_sigma. */
typedef struct sph_cleaning {
    sph_medium medium;
    sph_vectors field;
    sph_scalars psi, div_v;
    sph_real ch, sigma;
} sph_cleaning;
typedef struct sph_cleaning_out {
    sph_vector_out rate_B;
    SPH_GLOBAL sph_real *rate_psi, *div_B; /* div_B may be null */
    size_t stride;                         /* of these two */
    SPH_GLOBAL unsigned char *status;      /* may be null */
} sph_cleaning_out;
/* Divergence cleaning alone, for a host that has the rest of its MHD: dB/dt = -grad psi in symmetric form
   (23), dpsi/dt = -ch^2 div B - sigma ch psi / h - psi div v / 2 with div B in difference form (20), (25).
   div_v: sph_scalars_array(0) where nothing moves. div_B may be null. ch: one speed for all particles, the
   largest fast speed of the cloud (times an over-cleaning factor if the time step is divided by it); sigma:
   sph_cleaning_sigma(dim). Conserves sum m (B^2 + psi^2/ch^2) / (2 rho) but for the damping, which only
   takes, at any h and Omega; and sum m B / rho exactly. */
SPH_FN sph_index sph_cleaning_rates(sph_kernel k, int dim, sph_cloud cloud, sph_cleaning state,
                                    sph_cleaning_out out)
{
    const sph_medium medium = state.medium;
    const sph_vectors field = state.field;
    const sph_scalars psi = state.psi, div_v = state.div_v;
    const sph_real ch = state.ch, sigma = state.sigma;
    const size_t stride = sphi_stride(out.stride);
    int error = sphi_check_medium(k, dim, cloud, medium);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_vectors("field", dim, field, cloud.points.n);
    if (!error) error = sphi_check_field("psi", psi, cloud.points.n);
    if (!error && div_v.p) error = sphi_check_field("div_v", div_v, cloud.points.n);
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
        SPH_SUM(sx, sy, sz, divergence)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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
        divergence *= rho_i; /* w.i has g_i, which is F_i / (Omega rho) over rho */
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

/* A magnetised gas; n numbers each, all sources. */
typedef struct sph_mhd {
    sph_medium medium;
    sph_scalars p, u, cs; /* pressure, thermal energy per mass, sound speed */
    sph_scalars alpha,
        alpha_B; /* viscosity and resistivity of each particle, 0 ... 1 (0: none); a pair takes the mean */
    sph_vectors v, field; /* three components each if v.z has an array, else dim */
    sph_scalars psi;      /* null array: no cleaning */
    sph_real ch, sigma;
    sph_real beta, alpha_u; /* 2 and 1 are usual; alpha_u = 0: no conductivity */
    /* the part of (9) that is subtracted: 1 all, 0 none (momentum is conserved then, and particles pair where
       B^2/2 > P) */
    sph_real tensile;
} sph_mhd;
/* Where rates go; null pointers are not wanted (accelerations and rate_B are). */
typedef struct sph_mhd_out {
    sph_vector_out acceleration, rate_B;
    SPH_GLOBAL sph_real *rate_u, *rate_psi, *div_B, *div_v, *v_sig;
    size_t stride; /* of these five */
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
            SPH_SUM(ax, ay, az, tension, sv, sB, heat, ix, iy, iz, cx, cy, cz, rx, ry, rz)
            for (p = tile; p < end; p++) {
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
                /* 0 beyond both supports; no comparison, which would keep gcc from vectorising */
                v_sig[p - tile] =
                    c.speed * (SPH_R(0.5) +
                               SPHI_COPYSIGN(SPH_R(0.5),
                                             support * SPH_R(0.5) * (h_i + h_j + SPHI_ABS(h_i - h_j)) - f.r));
            }
            for (p = tile; p < end; p++)
                sums.speed = v_sig[p - tile] > sums.speed ? v_sig[p - tile] : sums.speed;
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
/* with what the loop may know as constants */
SPH_FN sph_index sphi_mhd_some(int parts, int cleans, sph_kernel k, int dim, sph_cloud cloud,
                               const sph_mhd *s, const sph_mhd_out *out)
{
    if (cleans)
        return cloud.h.stride ? sphi_mhd_range(0, parts, 1, k, dim, cloud, s, out)
                              : sphi_mhd_range(1, parts, 1, k, dim, cloud, s, out);
    return cloud.h.stride ? sphi_mhd_range(0, parts, 0, k, dim, cloud, s, out)
                          : sphi_mhd_range(1, parts, 0, k, dim, cloud, s, out);
}
SPH_FN int sphi_check_mhd(sph_kernel k, int dim, sph_cloud cloud, const sph_mhd *s)
{
    const int parts = sphi_components(dim, s->v);
    int error = sphi_check_medium(k, dim, cloud, s->medium);
    if (!error) error = sphi_check_field("p", s->p, cloud.points.n);
    if (!error) error = sphi_check_field("cs", s->cs, cloud.points.n);
    if (!error) error = sphi_check_vectors("v", parts, s->v, cloud.points.n);
    if (!error) error = sphi_check_vectors("field", parts, s->field, cloud.points.n);
    if (!error && !sphi_finite(s->beta)) error = sphi_refuse("state.beta", -1, SPH_ERROR_VALUE);
    return error;
}
/* All rates of a magnetised gas in one pass:
       dv/dt: (6), less `tensile` times (9); artificial viscosity alpha v_sig where particles approach
       dB/dt: (7), of B itself; -grad psi (23); resistivity (10)
       du/dt: P / (Omega rho^2) sum_j m_j v_ij . grad W, heating by viscosity, resistivity (both >= 0) and
       conductivity dpsi/dt: (2), (25); div B: (20); div v.
   Without (9) the sum m (v^2/2 + u + B^2 / (2 rho) + psi^2 / (2 rho ch^2)) changes by the damping of psi
   only, to round-off, and momentum does not; with (9) momentum changes by sum m B (div B). Density from
   sph_density_adaptive (its rate is -rho div v). v_sig: the largest of a target with its neighbours within
   the larger support, for time steps and switches; without any, its own fast speed. */
SPH_FN sph_index sph_mhd_rates(sph_kernel k, int dim, sph_cloud cloud, sph_mhd state, sph_mhd_out out)
{
    const int parts = sphi_components(dim, state.v), cleans = state.psi.p != 0;
    int error = sphi_check_mhd(k, dim, cloud, &state);
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

/* ================================================================ gravity, three dimensions
   E = G/2 sum_i sum_j m_i m_j (phi(r, h_i) + phi(r, h_j)) / 2, a particle with itself included. With an h
   that follows the density E depends on it, too, and forces have a second part (sph_gravity_correction)
   without which energy is not conserved. Price & Monaghan 2007, MNRAS 374, 1347. Kernels with
   sph_kernel_has_gravity only (SPH_ERROR_KERNEL). */

/* (1/r) d/dr of the mean of two softenings: a_i = -G sum_j m_j sph_gravity_pair x_ij. Beyond both supports
   Newton's 1/r^3; 0 between coincident particles, because x_ij is. */
SPH_FN sph_real sph_gravity_pair(sph_kernel k, sph_real r, sph_real h_i, sph_real h_j)
{
    return SPH_R(0.5) * (sph_gravity_force(k, r, h_i) + sph_gravity_force(k, r, h_j));
}
/* What self-gravity adds where h follows the density: weight of -G m_j x_ij in the acceleration of i: (zeta_i
   F_i / Omega_i + zeta_j F_j / Omega_j) / 2; scaled = zeta / Omega. Price & Monaghan 2007, MNRAS 374,
   1347. */
SPH_FN sph_real sph_gravity_correction_pair(sph_pair_kernel f, sph_real scaled_i, sph_real scaled_j)
{
    return SPH_R(0.5) * (scaled_i * f.f_i + scaled_j * f.f_j);
}
/* zeta_i = dh_i/drho_i sum_j m_j dphi/dh(r, h_i), the particle itself included, dh/drho = -h / (3 rho): (22)
   there. */
SPH_FN sph_real sph_gravity_zeta_value(sph_real h, sph_real rho, sph_real sum)
{
    return -h / (SPH_R(3) * rho) * sum;
}

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
/* Acceleration and potential G sum_j m_j (phi(r, h_i) + phi(r, h_j)) / 2 (itself included; may be null) of
   the targets, by all sources: n^2 steps, for small clouds and to measure trees against. Isolated: box
   lengths are not looked at. Momentum is conserved to round-off. */
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
/* zeta_i = dh_i/drho_i sum_j m_j dphi/dh(r, h_i), itself included, dh/drho = -h / (3 rho): (22) there. Lists
   as for the density. */
SPH_FN sph_index sph_gravity_zeta(sph_kernel k, sph_cloud cloud, sph_scalars m, sph_scalars rho,
                                  sph_scalar_out out)
{
    int error = sphi_check_sweep(k, 3, cloud, "m", m);
    sph_index i, p, failed = 0;
    if (error >= 0 && !sph_kernel_has_gravity(k)) error = sphi_refuse("kernel", -1, SPH_ERROR_KERNEL);
    if (!error) error = sphi_check_positive("rho", rho, cloud.points.n);
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
/* What self-gravity adds where h follows the density: a_i = -(G/2) sum_j m_j (zeta_i F_i / Omega_i + zeta_j
   F_j / Omega_j) x_ij, pairwise antisymmetric. Lists of all pairs within the larger support (SPH_LARGER). */
SPH_FN sph_index sph_gravity_correction(sph_kernel k, sph_cloud cloud, sph_medium medium, sph_scalars zeta,
                                        sph_real newton, sph_vector_out acceleration)
{
    int error = sphi_check_medium(k, 3, cloud, medium);
    sph_index i, p, failed = 0;
    if (!error) error = sphi_check_field("zeta", zeta, cloud.points.n);
    if (!error) error = sphi_check_out("acceleration", 3, acceleration);
    if (!error && !sphi_finite(newton)) error = sphi_refuse("newton", -1, SPH_ERROR_VALUE);
    if (error) return sphi_answer_of(error);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec x_i = sphi_point(3, cloud.points, i);
        const sph_real h_i = sphi_at(cloud.h, i), own = sphi_at(zeta, i) / sphi_at(medium.omega, i);
        sph_real ax = SPH_R(0), ay = SPH_R(0), az = SPH_R(0);
        sph_vec sum;
        SPH_SUM(ax, ay, az)
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
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

/* ================================================================ measures of a cloud: how the particles
   lie, and what they conserve */

/* The distance from each target to its nearest source in the list; 0 and SPH_TOO_FEW where the list is empty.
   targets and sources may be the same points, or probes and particles (lists by SPH_LIST_FOREIGN): then the
   share of probes with none within a distance is the void fraction. The box is that of the sources. */
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

/* The hexatic order |sum exp(6 i theta)| / 6 over the six nearest neighbours, 2D: 1 on a hexagonal lattice,
   about 0.36 for random particles. 0 and SPH_TOO_FEW where there are fewer than six. Nelson & Halperin 1979,
   PRB 19, 2457. */
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
            u = e.x * e.x / d, v = e.y * e.x / d; /* cos^2, cos sin: angles doubled and tripled from them */
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

/* The radial distribution function: g[b] for r between b and b + 1 times farthest / bins: pairs found in a
   shell per target over those expected at the number density (particles per volume). 1 far from a particle in
   a large cloud. Full lists that hold every pair within farthest. Returns how many shells are so small or
   large that g overflows (it is 0 there), or an error. Without targets g is not touched. */
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

/* Coincident pairs: targets that have a source within `distance` (1e-12 h: what the forces leave alone).
   Returns their number. */
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
/* Where to put target i so that it leaves those that it coincides with: a step of `distance` in a direction
   that depends on its index only (the golden angle, so that no two nearby indices get the same): no force has
   a direction there, and neither kernels nor collisions separate such a pair. Writes the new position; those
   who coincide with nobody keep theirs. Returns how many were moved. The host wraps and stores them. */
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
                at = was; /* there is no number for where it would be */
            moved++;
        }
        sphi_store_vector(dim, position, i, at);
    }
    return moved;
}

/* Mass, momentum, angular momentum about the origin and kinetic energy of particles first ... last - 1; sums
   of compensated rounding (Kahan), for the last digits of what ought not to change. */
typedef struct sph_conserved {
    sph_real mass, kinetic_energy;
    sph_vec momentum, angular_momentum; /* in 2D the z component only */
} sph_conserved;
SPH_FN void sphi_add_compensated(sph_real *sum, sph_real *lost, sph_real value)
{
    const sph_real a = value - *lost, b = *sum + a;
    *lost = (b - *sum) - a;
    *sum = b;
}
/* Returns 0, 1 if a sum overflowed (*out then 0), or an error. x, v as they are: positions of a periodic box
   must be those that were not wrapped for the angular momentum to mean anything. */
SPH_FN sph_index sph_conserved_sums(int dim, sph_cloud cloud, sph_scalars m, sph_vectors v,
                                    sph_conserved *out)
{
    const sph_points x = cloud.points;
    sph_real sum[8], lost[8];
    sph_index i;
    int c, ok = 1, error = out ? sphi_check_targets(dim, cloud) : sphi_refuse("out", -1, SPH_ERROR_NULL);
    if (!error) error = sphi_check_arrays(dim, x);
    if (!error && cloud.checked != 1) error = sphi_check_positions(dim, x);
    if (!error) error = sphi_check_field("m", m, x.n);
    if (!error) error = sphi_check_vectors("v", dim, v, x.n);
    if (error < 0) return error;
    for (c = 0; c < 8; c++) sum[c] = lost[c] = SPH_R(0);
    for (i = cloud.first; i < cloud.last; i++) {
        const sph_vec r = sphi_point(dim, x, i), u = sphi_vector_at(dim, v, i);
        const sph_real m_i = sphi_at(m, i);
        sph_real term[8];
        term[0] = m_i;
        term[1] = SPH_R(0.5) * m_i * sph_dot(dim, u, u);
        term[2] = m_i * u.x;
        term[3] = m_i * u.y;
        term[4] = m_i * u.z;
        term[5] = m_i * (r.y * u.z - r.z * u.y);
        term[6] = m_i * (r.z * u.x - r.x * u.z);
        term[7] = m_i * (r.x * u.y - r.y * u.x);
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
 * Some mistakes pass every check of a sweep: it answers 0, and its numbers are nonsense. sph_cloud_examine
 * looks for them. Call it once on a new cloud, and always in a test suite:
 *
 *     sph_findings found;
 *     if (sph_cloud_examine(SPH_WENDLAND_C2, 3, cloud, 0, 0, &found) > 0)
 *         for (i = 0; i < SPH_FINDING_COUNT; i++)
 *             if (found.set & (1u << i))
 *                 printf("particle %d: %s\n", (int)found.at[i].particle, sph_finding_text(i));
 */

/* What may be wrong. sph_finding_text says it in words. */
typedef enum sph_finding {
    SPH_FINDING_LIST_SHORT,     /* every row ends before the support does */
    SPH_FINDING_LIST_SUPPORT,   /* every row ends at h: h and the support radius are mixed up */
    SPH_FINDING_LIST_HALF,      /* each pair stands in one of its two rows only */
    SPH_FINDING_LIST_ONE_SIDED, /* pairs are missing that lie between the supports of their two particles */
    SPH_FINDING_LIST_STALE,     /* rows lack what is nearer than what they hold: a list of other positions */
    SPH_FINDING_LIST_FROM_ONE,  /* indices or starts count from 1 */
    SPH_FINDING_BOX,            /* positions and list do not have the same periodic box */
    SPH_FINDING_VOLUME_ZERO,    /* a volume is negative, or more than half of them are 0 */
    SPH_FINDING_VOLUME_SUM,     /* sum_j V_j W_ij in the interior is far from 1: masses, perhaps */
    SPH_FINDING_DIM_HIGH,       /* a coordinate is the same for all particles: dim is too high */
    SPH_FINDING_DIM_LOW,        /* particles differ in a coordinate beyond dim: dim is too low */
    SPH_FINDING_STRIDE,         /* positions: a stride in bytes, or components that share memory */
    SPH_FINDING_COUNT
} sph_finding;

/* Where it shows first: a particle, a neighbour (-1: none) and the number that tells:
     LIST_*, BOX    distance / support radius that decides for this pair
     LIST_FROM_ONE  0; neighbour is the entry as it stands in the list
     VOLUME_ZERO    the volume
     VOLUME_SUM     the sum
     DIM_HIGH       0
     DIM_LOW        the difference of the two particles / support radius
     STRIDE         the distance of the pointers of two components that share memory, in sph_real;
                    else given stride / likely stride */
typedef struct sph_offender {
    sph_index particle, neighbour;
    sph_real ratio;
    SPHI_TCC_PAD
} sph_offender;

typedef struct sph_findings {
    unsigned set;                       /* 1u << finding for each that was made */
    sph_offender at[SPH_FINDING_COUNT]; /* particle -1 where there is no finding */
    sph_index sampled;                  /* targets that were compared with all particles */
    sph_index interior; /* of these, those that have particles on all sides; 0 without volumes */
    /* sum_j V_j W_ij of these: near 1 in a healthy cloud; 0 if interior is 0 */
    sph_real sum_lowest, sum_highest;
} sph_findings;

/* what is asked: the cloud as it is, or as it would be if a guess were right */
typedef struct sphi_case {
    sph_cloud cloud;
    sph_vec extent;                    /* of all positions */
    sph_real support_ratio, largest;   /* support / h, and the largest support radius */
    sph_index start_base, index_base;  /* what the list counts from */
    int dim, both_sides, with_volumes; /* with_volumes: sums, too */
} sphi_case;

/* what the sampled rows show */
typedef struct sphi_tally {
    size_t rows, needed, listed, outside,
        self; /* pairs needed; entries listed, no particle, the particle itself */
    size_t missing, missing_across, missing_between;
    size_t pairs_both, pairs_one,
        pairs_none; /* pairs of two targets that need each other: in how many of the two rows */
    size_t wide, interior;
    int ends_by_distance, ends_by_ratio;    /* 1: each row holds what is nearer, and lacks what is farther */
    sph_real own_listed, own_missing;       /* r / h_i: largest listed, smallest missing */
    sph_real larger_listed, larger_missing; /* r / max(h_i, h_j) */
    sph_real sum_lowest, sum_highest;       /* sum_j V_j W_ij */
    sph_offender lacking, distant, sum_low,
        sum_high; /* the first that lacks a neighbour, or has a wide one */
} sphi_tally;

/* Distances within 1e-3 of a radius count as on either side of it: rounding, and lattices with a shell
   there. */
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
/* the row of target i: 1 if it holds j */
SPH_FN int sphi_row_holds(const sphi_case *c, sph_index i, sph_index j)
{
    const sph_list list = c->cloud.list;
    const sph_index end = list.start[i + 1] - c->start_base;
    sph_index p;
    for (p = list.start[i] - c->start_base; p < end; p++)
        if (list.index[p] - c->index_base == j) return 1;
    return 0;
}
/* one pair: its distance (nearest image), and that distance by the larger of both support radii */
typedef struct sphi_measure {
    sph_vec d;
    sph_real r, q, own, other; /* own, other: support radii of i and j */
    int across;                /* through the box */
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
/* the radius within which target i must have j, less the slack; and the same seen from j */
SPH_FN sph_real sphi_reach_own(const sphi_case *c, sphi_measure s)
{
    return (SPH_R(1) - SPHI_SLACK) * (c->both_sides && s.other > s.own ? s.other : s.own);
}
SPH_FN sph_real sphi_reach_other(const sphi_case *c, sphi_measure s)
{
    return (SPH_R(1) - SPHI_SLACK) * (c->both_sides && s.own > s.other ? s.own : s.other);
}
/* particle `i` lacks `j`; h_i is its own */
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
/* 1: the particle has others on all sides. From the sums of the vectors to them, of their lengths and
   products. */
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

/* Target i: its row against all particles. Cost n + (neighbours)^2. */
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
    /* A hole: not listed, but much nearer than something that is. Not 1.5: pairs of a lattice lie there. */
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

/* The targets to look at: `samples` of them (1 to the length of the range), one in each of as many equal
   parts of the range, and up to 8 that stand out. The place within a part varies: else all may be of one
   column of a lattice. */
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

/* All pairs of the list, those through the box apart from the others: the lengths r, and r / larger
   support. */
typedef struct sphi_lengths {
    size_t inside, across;                           /* pairs */
    sph_real inside_r, inside_q, across_r, across_q; /* the largest */
    sph_real inside_lowest, across_lowest;           /* the smallest r / larger support */
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

/* Pointers to two components of n particles: 1 if the one of some particle is the other of some other.
   *apart: their distance in sph_real. */
SPH_FN int sphi_same_memory(const SPH_GLOBAL sph_real *a, const SPH_GLOBAL sph_real *b, size_t stride,
                            sph_index n, sph_real *apart)
{
    const size_t p = (size_t)a, q = (size_t)b, width = stride * sizeof(sph_real),
                 bytes = p > q ? p - q : q - p;
    *apart = SPH_R(bytes / sizeof(sph_real));
    return bytes % width == 0 && bytes / width < (size_t)n;
}
/* A component that dim does not read: the first particle that differs in it from particle 0, or -1. */
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
/* Smallest and largest of a component over all particles; extra[0], extra[1] get the targets where it is
   smallest and largest. Answers 0 if a value is not finite. */
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

/* What the rows say about list and box. At most one finding: the one that explains all that is missing. */
SPH_FN void sphi_judge_list(const sphi_case *c, const sphi_tally *t, sph_findings *f)
{
    const sph_real low = SPH_R(1) - SPHI_SLACK, high = SPH_R(1) + SPHI_SLACK;
    const sphi_lengths v = sphi_list_lengths(c);
    if (!t->missing) {
        /* Pairs through the box are longer than all others, or the only ones that coincide: a wrong
           length. */
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
        sphi_find(f, SPH_FINDING_BOX, t->lacking); /* as far inside the list is complete */
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

/* Looks for the likely mistakes in a cloud (enum sph_finding), and reports of each kind the first particle
   and neighbour that show it.
   both_sides    0: the operator needs all r < support * h_i (gather);
                 1: it sums over pairs and needs all r < support * max(h_i, h_j)
   samples       how many targets are compared with all particles; <= 0: 16. To these come those with
                 extreme coordinates and h, up to 8
   volume        sph_scalars_none(): not looked at. A volume of 0 is a probe; more than half of all
                 particles cannot be probes
   y, z          beyond dim are read here (and nowhere else) if they are not null, to find a dim that is
                 too low
   Assumed: arrays are as long as n and the strides say, list.index as long as the starts say (one less, if
   these count from 1).
   Answers the number of findings, 0 for a healthy or an empty cloud; or a negative sph_error, and then
   nothing was written. What a sweep would refuse is such an error, but a finding that explains it comes
   first: LIST_FROM_ONE instead of SPH_ERROR_LIST or SPH_ERROR_SELF. Findings that only follow from another
   are left out: put right what was found, and ask again.
   Cost: (samples + 8) * (n + neighbours^2), up to 4 times that where something is wrong, and one or two
   passes over the list. The same whatever SPH_CHECK is.
   What it cannot see: what no sampled target sees; masses where densities are within 0.67 ... 1.5; h too
   large, with volumes and a list that fit; most boxes that are wrong by less than a spacing; starts that
   count from 1, in a range that does not begin at 0 (the last entry of its last row is then read one place
   too far). */
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

    /* numbers: positions, h, volumes */
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

    /* the list: starts that ascend, entries that are particles */
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

    /* positions: memory shared by two components, dim */
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

    /* rows against all particles: as given; and if that is not well, as if entries, or entries and starts,
       counted from 1, or as if the stride were in bytes. A guess is right if nothing is missing then. */
    given.cloud = cloud;
    given.dim = dim;
    given.both_sides = both_sides;
    given.extent = sph_subtract(dim, high, low);
    if (samples <= 0) samples = 16;
    if (samples > cloud.last - cloud.first) samples = cloud.last - cloud.first;
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
/* what an sph_finding means, and what to do */
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
