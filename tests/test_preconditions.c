/* SPDX-License-Identifier: MIT */
/*
 * test_preconditions.c - what every scalar function of the headers needs, as SPH_ASSERT is told.
 *
 * The table has an entry for each function that takes numbers, not arrays:
 *     FUNCTION(name)            begins the entry
 *     ALLOWED(type, call)       arguments at the ends of what is allowed: no assertion, and finite numbers
 *     FORBIDDEN(call)           an argument that would make the answer NaN, infinite or nonsense: an
 *                               assertion
 * A function without FORBIDDEN has an answer for all numbers. The headers are read when the test runs (from
 * the repository's root), and a scalar function that has no entry fails.
 */
#include <setjmp.h>

static int asserted; /* assertions that did not hold */
static int stops;    /* 1: the first one ends the call, at the place where it began */
static jmp_buf beginning;
static void assertion(void)
{
    asserted++;
    if (stops) longjmp(beginning, 1);
}
#define SPH_ASSERT(x) ((x) ? (void)0 : assertion())
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <float.h>
#include <string.h>

/* ---- what an answer is made of: how many numbers */

#define NUMBERS_sph_real 1
#define NUMBERS_sph_vec 3
#define NUMBERS_sph_sym 6
#define NUMBERS_sph_wf 2
#define NUMBERS_sph_density_sums 2
#define NUMBERS_sph_test_weights 2
#define NUMBERS_sph_moments ((int)(sizeof(sph_moments) / sizeof(sph_real)))
#define NUMBERS_sph_jet 9
#define NUMBERS_sph_coefficients 10
#define NUMBERS_sph_kernel_gradient 4
#define NUMBERS_sph_elliptic_moments 21
#define NUMBERS_sph_fluid_change 5
#define NUMBERS_sph_viscosity_force 2
#define NUMBERS_sph_fit ((int)(sizeof(sph_fit) / sizeof(sph_real)))
#define NUMBERS_sph_fit_rows 16
#define NUMBERS_sph_wall_sums 5
#define NUMBERS_sph_dfsph_sums 4
#define NUMBERS_sph_transport_change 6
#define NUMBERS_sph_riemann_side 3
#define NUMBERS_sph_wall_part 4
#define NUMBERS_sph_wall_kernel_numbers 5
#define NUMBERS_sph_unit_normal 4
#define NUMBERS_sph_curvature_sums 2
#define NUMBERS_sph_riemann_star 3
#define NUMBERS_sph_pair_weights 2
#define NUMBERS_sph_mhd_sums 17
#define NUMBERS_sph_gas_sums 6
#define NUMBERS_sph_gas_change 5
#define NUMBERS_sph_flow 4
#define NUMBERS_sph_velocity_gradient 9
#define NUMBERS_sph_mhd_change 10
#define NUMBERS_sph_mat 9
#define NUMBERS_sph_rk_moments 29
#define NUMBERS_sph_rk_kernel 4
#define NUMBERS_sph_corrected_change 4
#define NUMBERS_sph_elastic 2
/* with the member that some structs have where tcc compiles them, which is not a number of the answer */
#if defined(__TINYC__)
#define ARE_NUMBERS(type, size) 0
#else
#define ARE_NUMBERS(type, size) ((size) == NUMBERS_##type * sizeof(sph_real))
#endif

enum { MOST = 200 };
static const char *entry[MOST]; /* the functions of the table */
static int entries, allowed;

static void begin(const char *name)
{
    if (entries > 0) CHECK_AT(entry[entries - 1], 0, allowed > 0);
    if (entries < MOST) entry[entries++] = name;
    allowed = 0;
}
static void answered(const void *answer, size_t count, const char *call)
{
    size_t c;
    int finite = 1;
    for (c = 0; c < count; c++) finite &= sphi_finite(((const sph_real *)answer)[c]);
    allowed++;
    if (!check_count(asserted == 0 && finite))
        fprintf(stderr, "test_preconditions.c: failed: %s: %s\n", call,
                asserted ? "an assertion" : "not finite");
}
static void refused(const char *call)
{
    if (!check_count(asserted > 0)) fprintf(stderr, "test_preconditions.c: failed: %s: no assertion\n", call);
}

#define FUNCTION(name) begin(#name);
#define ALLOWED(type, call) \
    { \
        type answer; \
        asserted = 0; \
        answer = call; \
        answered(&answer, ARE_NUMBERS(type, sizeof answer) ? sizeof answer / sizeof(sph_real) : 0, #call); \
    }
/* an answer that is no number, or goes elsewhere */
#define ALLOWED_STATE(expected, call) \
    { \
        asserted = 0; \
        CHECK((call) == (expected)); \
        answered(0, 0, #call); \
    }
#define FORBIDDEN(call) \
    { \
        asserted = 0; \
        (void)(call); \
        refused(#call); \
    }
/* the same for a call with a dimension that does not exist, after which memory would be at risk */
#define FORBIDDEN_DIM(call) \
    for (dim = 0; dim <= 4; dim += 4) { \
        asserted = 0; \
        until_assertion(call, dim); \
        refused(#call); \
    }
static void until_assertion(void (*call)(int), int dim)
{
    stops = 1;
    if (!setjmp(beginning)) call(dim);
    stops = 0;
}
/* what no length is: negative, 0, NaN */
#define FORBIDDEN_LENGTH(x, call) \
    for (x = SPH_R(-1); x <= SPH_R(0); x += SPH_R(1)) FORBIDDEN(call) \
    x = not_a_number; \
    FORBIDDEN(call)
/* negative and NaN */
#define FORBIDDEN_BELOW_0(x, call) \
    x = -small_number; \
    FORBIDDEN(call) \
    x = not_a_number; \
    FORBIDDEN(call)

/* ---- arguments */

static const sph_real zero = SPH_R(0), one = SPH_R(1);
/* small, and its sixth power no denormal number; large, and its square finite */
static sph_real not_a_number, infinite, small_number, large, short_h;
static const sph_kernel k0 = SPH_WENDLAND_C2, no_gravity = SPH_HERMITE, no_kernel = SPH_KERNEL_COUNT;

static sph_vec vec(sph_real x, sph_real y, sph_real z)
{
    sph_vec v = {0};
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
static sph_sym sym(sph_real diagonal, sph_real xy)
{
    const sph_sym s = {diagonal, xy, diagonal, xy, xy, diagonal};
    return s;
}
static sph_fluid_side fluid(sph_real m, sph_real rho, sph_real p, sph_real mu)
{
    const sph_fluid_side s = {m, rho, p, mu};
    return s;
}
static sph_encounter meeting(sph_real vx, sph_real r, sph_real h, sph_real c, sph_real rho)
{
    const sph_encounter e = {vx, r, h, c, rho};
    return e;
}
static sph_tait tait(sph_real rho0, sph_real c, sph_real gamma)
{
    const sph_tait t = {rho0, c, gamma, SPH_R(0)};
    return t;
}
static sph_density_sums sums_of(sph_real weight, sph_real slope)
{
    const sph_density_sums s = {weight, slope};
    return s;
}
static sph_wall_sums wall_sums(sph_real weight)
{
    sph_wall_sums s = {0};
    s.weight = weight;
    return s;
}
static sph_impact impact(sph_real w_i, sph_real w_j, sph_real r2)
{
    const sph_impact c = {w_i, w_j, SPH_R(-1), r2};
    return c;
}
static sph_cleaning_wave wave(sph_real ch, sph_real sigma, sph_real h)
{
    sph_cleaning_wave w = {0};
    w.ch = ch;
    w.sigma = sigma;
    w.h = h;
    return w;
}
static sph_switch bounds(sph_real least, sph_real most)
{
    const sph_switch s = {SPH_R(0.5), least, most};
    return s;
}
static sph_medium_side medium(sph_real rho, sph_real omega)
{
    sph_medium_side a = {0};
    a.m = SPH_R(1);
    a.rho = rho;
    a.omega = omega;
    return a;
}
static sph_pair_kernel pair_kernel(sph_real r)
{
    sph_pair_kernel f = {0};
    f.r = r;
    f.f_i = f.f_j = SPH_R(-1);
    return f;
}
static sph_mhd_side magnetised(sph_real rho, sph_real omega)
{
    sph_mhd_side s = {0};
    s.medium = medium(rho, omega);
    s.p = s.u = s.cs = SPH_R(1);
    s.field = vec(one, one, one);
    return s;
}
static sph_gas_side plain(sph_real rho, sph_real omega)
{
    sph_gas_side s = {0};
    s.medium.m = SPH_R(1);
    s.medium.rho = rho;
    s.medium.omega = omega;
    return s;
}
static sph_flow flowing(sph_real curl, sph_real shear)
{
    sph_flow f = {0};
    f.curl = curl;
    f.shear = shear;
    return f;
}
static sph_shock shocked(sph_real factor, sph_real h, sph_real cs, sph_real v_sig)
{
    sph_shock s = {0};
    s.factor = factor;
    s.h = h;
    s.cs = cs;
    s.v_sig = v_sig;
    return s;
}
static sph_mhd_terms mhd_terms(int parts)
{
    const sph_mhd_terms t = {SPH_R(2), SPH_R(1), parts, 0};
    return t;
}
static sph_wf wf(sph_real w, sph_real f)
{
    const sph_wf v = {w, f};
    return v;
}
static sph_shepard shepard(sph_real nu)
{
    sph_shepard s = {0};
    s.nu = nu;
    return s;
}
static const sph_kernel_gradient no_gradient = {0};
static const sph_elliptic_correction no_correction = {0};
static const sph_mat no_inverse = {0};
static const sph_coefficients no_coefficients = {0};
static const sph_test_weights weights = {SPH_R(1), SPH_R(1)};

/* moments of particles on a cross, in each of dim dimensions */
static sph_moments cross(int dim, sph_test_weights (*of)(sph_kernel, int, sph_real, sph_real))
{
    sph_moments m = sph_moments_zero();
    int c;
    for (c = 0; c < (dim == 1 ? 3 : dim == 2 ? 9 : 27); c++) {
        const sph_vec e = vec(SPH_R(0.5 * (c % 3 - 1)), SPH_R(dim > 1 ? 0.5 * (c / 3 % 3 - 1) : 0),
                              SPH_R(dim > 2 ? 0.5 * (c / 9 - 1) : 0));
        if (sph_length(3, e) > zero) sph_moments_add(dim, &m, e, of(k0, dim, sph_length(3, e), one));
    }
    return m;
}

/* the sums of a linear fit on the same cross */
static sph_fit fit_cross(int dim)
{
    sph_fit m = sph_fit_zero();
    int c;
    for (c = 0; c < (dim == 1 ? 3 : dim == 2 ? 9 : 27); c++) {
        const sph_vec e = vec(SPH_R(0.5 * (c % 3 - 1)), SPH_R(dim > 1 ? 0.5 * (c / 3 % 3 - 1) : 0),
                              SPH_R(dim > 2 ? 0.5 * (c / 9 - 1) : 0));
        sph_fit_add(dim, &m, e, sph_test_weights_wls(k0, dim, sph_length(3, e), one));
    }
    return m;
}
static sph_bulk_pair bulk(sph_real zeta_i, sph_real zeta_j)
{
    const sph_bulk_pair b = {zeta_i, zeta_j};
    return b;
}

/* ---- the table */

static void kernels(void)
{
    int k, dim;
    sph_real x;
    /* all kernels and dimensions, q = 0 and as far as the header says */
    FUNCTION(sph_kernel_support_ratio)
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++) ALLOWED(sph_real, sph_kernel_support_ratio((sph_kernel)k))
    FORBIDDEN(sph_kernel_support_ratio(no_kernel))
    FORBIDDEN(sph_kernel_support_ratio((sph_kernel)-1))
    FUNCTION(sph_kernel_h_over_dx)
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++) ALLOWED(sph_real, sph_kernel_h_over_dx((sph_kernel)k))
    FORBIDDEN(sph_kernel_h_over_dx(no_kernel))
    FUNCTION(sph_kernel_h_from_support)
    ALLOWED(sph_real, sph_kernel_h_from_support(k0, small_number))
    FORBIDDEN_LENGTH(x, sph_kernel_h_from_support(k0, x))
    FORBIDDEN(sph_kernel_h_from_support(no_kernel, one))
    FUNCTION(sph_kernel_support)
    ALLOWED(sph_real, sph_kernel_support(k0, small_number))
    FORBIDDEN_LENGTH(x, sph_kernel_support(k0, x))
    FORBIDDEN(sph_kernel_support(no_kernel, one))
    FUNCTION(sph_kernel_sigma)
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++)
        for (dim = 1; dim <= 3; dim++) ALLOWED(sph_real, sph_kernel_sigma((sph_kernel)k, dim))
    FORBIDDEN(sph_kernel_sigma(no_kernel, 1))
    FORBIDDEN(sph_kernel_sigma(k0, 0))
    FORBIDDEN(sph_kernel_sigma(k0, 4))
#define AT_Q(function) \
    FUNCTION(function) \
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++) \
        for (dim = 1; dim <= 3; dim++) { \
            ALLOWED(sph_real, function((sph_kernel)k, dim, zero)) \
            ALLOWED(sph_real, function((sph_kernel)k, dim, small_number)) \
            ALLOWED(sph_real, function((sph_kernel)k, dim, sph_kernel_support_ratio((sph_kernel)k))) \
            ALLOWED(sph_real, function((sph_kernel)k, dim, SPH_R(1e9))) \
        } \
    FORBIDDEN(function(k0, 1, -small_number)) \
    FORBIDDEN(function(no_kernel, 1, one)) \
    FORBIDDEN(function(k0, 0, one)) \
    FORBIDDEN(function(k0, 4, one))
    AT_Q(sph_kernel_shape)
    AT_Q(sph_kernel_shape_f)
    AT_Q(sph_kernel_shape_d2)
#define AT_R(type, function) \
    FUNCTION(function) \
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++) \
        for (dim = 1; dim <= 3; dim++) { \
            ALLOWED(type, function((sph_kernel)k, dim, zero, one)) \
            ALLOWED(type, function((sph_kernel)k, dim, zero, short_h)) \
            ALLOWED(type, function((sph_kernel)k, dim, short_h, short_h)) \
            ALLOWED(type, function((sph_kernel)k, dim, SPH_R(1e9), one)) \
            ALLOWED(type, function((sph_kernel)k, dim, one, large)) \
        } \
    FORBIDDEN_BELOW_0(x, function(k0, 1, x, one)) \
    FORBIDDEN_LENGTH(x, function(k0, 1, one, x)) \
    FORBIDDEN(function(no_kernel, 1, one, one)) \
    FORBIDDEN(function(k0, 4, one, one))
    AT_R(sph_real, sph_kernel_w)
    AT_R(sph_real, sph_kernel_f)
    AT_R(sph_wf, sph_kernel_wf)
    AT_R(sph_real, sph_kernel_dwdr)
    AT_R(sph_real, sph_kernel_d2wdr2)
    AT_R(sph_real, sph_kernel_dwdh)
    AT_R(sph_real, sph_kernel_f_apart)
    FUNCTION(sph_kernel_has_cusp)
    ALLOWED_STATE(0, sph_kernel_has_cusp(no_kernel))
    FUNCTION(sph_kernel_may_convexify)
    ALLOWED_STATE(1, sph_kernel_may_convexify(k0, 3))
    FORBIDDEN(sph_kernel_may_convexify(no_kernel, 1))
    FORBIDDEN(sph_kernel_may_convexify(k0, 0))
    FUNCTION(sph_kernel_name)
    ALLOWED_STATE(1, sph_kernel_name(no_kernel) != 0)
    FUNCTION(sph_kernel_from_name)
    ALLOWED_STATE(-1, sph_kernel_from_name(0))
    FUNCTION(sph_status_text)
    ALLOWED_STATE(1, sph_status_text(-1000) != 0)
    FUNCTION(sph_finding_text)
    ALLOWED_STATE(1, sph_finding_text(-1) != 0)

    FUNCTION(sph_cohesion_kernel_akinci)
    ALLOWED(sph_real, sph_cohesion_kernel_akinci(zero, short_h))
    ALLOWED(sph_real, sph_cohesion_kernel_akinci(SPH_R(1e9), one))
    FORBIDDEN_BELOW_0(x, sph_cohesion_kernel_akinci(x, one))
    FORBIDDEN_LENGTH(x, sph_cohesion_kernel_akinci(one, x))
    FUNCTION(sph_adhesion_kernel_akinci)
    ALLOWED(sph_real, sph_adhesion_kernel_akinci(zero, short_h))
    ALLOWED(sph_real, sph_adhesion_kernel_akinci(SPH_R(1e9), one))
    FORBIDDEN_BELOW_0(x, sph_adhesion_kernel_akinci(x, one))
    FORBIDDEN_LENGTH(x, sph_adhesion_kernel_akinci(one, x))

    FUNCTION(sph_kernel_has_gravity)
    ALLOWED_STATE(0, sph_kernel_has_gravity(no_kernel))
#define GRAVITY_AT_Q(function) \
    FUNCTION(function) \
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++) { \
        if (sph_kernel_has_gravity((sph_kernel)k)) ALLOWED(sph_real, function((sph_kernel)k, zero)) \
        ALLOWED(sph_real, function((sph_kernel)k, small_number)) \
        ALLOWED(sph_real, function((sph_kernel)k, large)) \
    } \
    FORBIDDEN_BELOW_0(x, function(k0, x)) \
    FORBIDDEN_LENGTH(x, function(no_gravity, x))
    GRAVITY_AT_Q(sph_gravity_shape_f)
    GRAVITY_AT_Q(sph_gravity_shape)
#define GRAVITY_AT_R(function) \
    FUNCTION(function) \
    ALLOWED(sph_real, function(k0, zero, short_h)) \
    ALLOWED(sph_real, function(k0, large, short_h)) \
    ALLOWED(sph_real, function(k0, zero, large)) \
    FORBIDDEN_BELOW_0(x, function(k0, x, one)) \
    FORBIDDEN_LENGTH(x, function(k0, one, x)) \
    FORBIDDEN(function(no_gravity, one, one))
    GRAVITY_AT_R(sph_gravity_potential)
    GRAVITY_AT_R(sph_gravity_force)
    GRAVITY_AT_R(sph_gravity_dphidh)
    FUNCTION(sph_gravity_pair)
    ALLOWED(sph_real, sph_gravity_pair(k0, zero, short_h, large))
    FORBIDDEN_BELOW_0(x, sph_gravity_pair(k0, x, one, one))
    FORBIDDEN_LENGTH(x, sph_gravity_pair(k0, one, x, one))
    FORBIDDEN_LENGTH(x, sph_gravity_pair(k0, one, one, x))
    FORBIDDEN(sph_gravity_pair(no_gravity, one, one, one))
    FUNCTION(sph_gravity_correction_pair)
    ALLOWED(sph_real, sph_gravity_correction_pair(pair_kernel(zero), zero, large))
    FUNCTION(sph_gravity_zeta_value)
    ALLOWED(sph_real, sph_gravity_zeta_value(small_number, small_number, zero))
    FORBIDDEN_LENGTH(x, sph_gravity_zeta_value(x, one, one))
    FORBIDDEN_LENGTH(x, sph_gravity_zeta_value(one, x, one))
}

static sph_moments some_moments;
static void sph_solve_cspm_in(int dim)
{
    sph_jet jet;
    sph_solve_cspm(dim, &some_moments, one, &jet, 0);
}
static void sph_solve_block_in(int dim)
{
    sph_jet jet;
    sph_solve_block(dim, &some_moments, one, &jet, 0);
}
static void sph_coefficients_cspm_in(int dim)
{
    sph_coefficients c;
    sph_coefficients_cspm(dim, &some_moments, one, sph_jet_laplacian(3), &c, 0);
}
static void sph_coefficients_block_in(int dim)
{
    sph_coefficients c;
    sph_coefficients_block(dim, 1, &some_moments, one, sph_jet_laplacian(3), &c, 0);
}
static void sph_elliptic_invert_in(int dim)
{
    const sph_elliptic_moments m = sph_elliptic_moments_radial(sym(one, zero), vec(zero, zero, zero));
    sph_mat inverse;
    sph_elliptic_invert(dim, SPH_GRADIENT_FULL, &m, &inverse, 0);
}
static void sph_sym_eigenvalues_in(int dim) { sph_sym_eigenvalues(dim, sym(one, zero)); }

static void vectors_and_systems(void)
{
    const sph_vec v = vec(large, zero, -large), nothing = vec(zero, zero, zero);
    sph_moments m;
    sph_jet jet = sph_jet_laplacian(3);
    sph_coefficients c = no_coefficients;
    sph_fit fit;
    sph_fit_rows fit_rows;
    sph_mat inverse;
    sph_elliptic_moments em;
    sph_sym s;
    sph_real x;
    int dim;
    FUNCTION(sph_dot)
    ALLOWED(sph_real, sph_dot(3, v, nothing))
    FORBIDDEN(sph_dot(0, v, v))
    FORBIDDEN(sph_dot(4, v, v))
    FUNCTION(sph_scale)
    ALLOWED(sph_vec, sph_scale(zero, v))
    FUNCTION(sph_subtract)
    ALLOWED(sph_vec, sph_subtract(1, v, v))
    FORBIDDEN(sph_subtract(0, v, v))
    FUNCTION(sph_length)
    ALLOWED(sph_real, sph_length(3, nothing))
    FORBIDDEN(sph_length(4, v))

    FUNCTION(sph_density_pair)
    ALLOWED(sph_density_sums, sph_density_pair(k0, 3, zero, one))
    ALLOWED(sph_density_sums, sph_density_pair(k0, 3, SPH_R(1e9), -one))
    FORBIDDEN(sph_density_pair(k0, 3, -small_number, one))
    FUNCTION(sph_density_value)
    ALLOWED(sph_real, sph_density_value(k0, 3, sums_of(zero, zero), short_h))
    FORBIDDEN_LENGTH(x, sph_density_value(k0, 3, sums_of(one, one), x))
    FUNCTION(sph_density_omega)
    ALLOWED(sph_real, sph_density_omega(3, sums_of(small_number, zero)))
    FORBIDDEN_LENGTH(x, sph_density_omega(3, sums_of(x, one)))
    FORBIDDEN(sph_density_omega(0, sums_of(one, one)))
    FUNCTION(sph_density_mismatch)
    ALLOWED(sph_real, sph_density_mismatch(k0, 3, sums_of(small_number, zero), large, small_number))
    FORBIDDEN_LENGTH(x, sph_density_mismatch(k0, 3, sums_of(x, one), one, one))
    FORBIDDEN_LENGTH(x, sph_density_mismatch(k0, 3, sums_of(one, one), x, one))
    FORBIDDEN_LENGTH(x, sph_density_mismatch(k0, 3, sums_of(one, one), one, x))

    FUNCTION(sph_gradient_pair_difference)
    ALLOWED(sph_vec, sph_gradient_pair_difference(k0, 3, one, zero, nothing, zero, short_h))
    FORBIDDEN_BELOW_0(x, sph_gradient_pair_difference(k0, 3, one, one, nothing, x, one))
    FORBIDDEN_LENGTH(x, sph_gradient_pair_difference(k0, 3, one, one, nothing, one, x))
    FUNCTION(sph_laplacian_weight_brookshaw)
    ALLOWED(sph_real, sph_laplacian_weight_brookshaw(k0, 3, zero, short_h, zero))
    FORBIDDEN_BELOW_0(x, sph_laplacian_weight_brookshaw(k0, 3, x, one, one))
    FORBIDDEN_LENGTH(x, sph_laplacian_weight_brookshaw(k0, 3, one, x, one))
    FUNCTION(sph_moment_weight_iad)
    ALLOWED(sph_real, sph_moment_weight_iad(k0, 3, zero, short_h, zero))
    FORBIDDEN_BELOW_0(x, sph_moment_weight_iad(k0, 3, x, one, one))
    FORBIDDEN_LENGTH(x, sph_moment_weight_iad(k0, 3, one, x, one))
    FUNCTION(sph_moment_weight_gradient)
    ALLOWED(sph_real, sph_moment_weight_gradient(k0, 3, zero, short_h, zero))
    FORBIDDEN_BELOW_0(x, sph_moment_weight_gradient(k0, 3, x, one, one))
    FORBIDDEN_LENGTH(x, sph_moment_weight_gradient(k0, 3, one, x, one))
    FUNCTION(sph_solve_gradient)
    ALLOWED_STATE(SPH_SINGULAR, sph_solve_gradient(3, sym(zero, zero), &s, 0))
    ALLOWED_STATE(SPH_SINGULAR, sph_solve_gradient(3, sym(not_a_number, zero), &s, 0))
    ALLOWED_STATE(SPH_SINGULAR, sph_solve_gradient(2, sym(one, not_a_number), &s, 0))
    ALLOWED_STATE(SPH_OK, sph_solve_gradient(3, sym(one, zero), &s, 0))
    ALLOWED(sph_sym, s)
    FORBIDDEN(sph_solve_gradient(0, sym(one, zero), &s, 0))
    FORBIDDEN(sph_solve_gradient(4, sym(one, zero), &s, 0))

    FUNCTION(sph_test_weights_cspm)
    ALLOWED(sph_test_weights, sph_test_weights_cspm(k0, 3, zero, one))
    ALLOWED(sph_test_weights, sph_test_weights_cspm(k0, 3, SPH_R(1e9), one))
    FORBIDDEN(sph_test_weights_cspm(k0, 3, -small_number, one))
    FUNCTION(sph_test_weights_wls)
    ALLOWED(sph_test_weights, sph_test_weights_wls(k0, 3, zero, one))
    FORBIDDEN(sph_test_weights_wls(k0, 3, -small_number, one))
    FUNCTION(sph_test_weights_fatehi_manzari)
    ALLOWED(sph_test_weights, sph_test_weights_fatehi_manzari(k0, 3, zero, one))
    ALLOWED(sph_test_weights, sph_test_weights_fatehi_manzari(k0, 3, SPH_R(1e9), one))
    FORBIDDEN(sph_test_weights_fatehi_manzari(k0, 3, -small_number, one))
    FUNCTION(sph_test_weights_liu)
    ALLOWED(sph_test_weights, sph_test_weights_liu(k0, 3, zero, one))
    FORBIDDEN(sph_test_weights_liu(k0, 3, -small_number, one))
    FUNCTION(sph_moments_zero)
    ALLOWED(sph_moments, sph_moments_zero())
    m = sph_moments_zero();
    FUNCTION(sph_moments_add)
    ALLOWED(sph_moments, (sph_moments_add(3, &m, nothing, weights), m))
    FORBIDDEN((sph_moments_add(0, &m, nothing, weights), 0))
    FUNCTION(sph_moments_add_value)
    ALLOWED(sph_moments, (sph_moments_add_value(3, &m, nothing, weights, large), m))
    FORBIDDEN((sph_moments_add_value(4, &m, nothing, weights, one), 0))
    FUNCTION(sph_jet_laplacian)
    ALLOWED(sph_jet, sph_jet_laplacian(1))
    FORBIDDEN(sph_jet_laplacian(0))
    FORBIDDEN(sph_jet_laplacian(4))
#define SYSTEM(function, of, state, call, result) \
    FUNCTION(function) \
    m = sph_moments_zero(); \
    dim = 3; \
    x = one; \
    ALLOWED_STATE(SPH_SINGULAR, call) \
    for (dim = 1; dim <= 3; dim++) { \
        m = cross(dim, of); \
        x = SPH_R(0.01); \
        ALLOWED_STATE(SPH_OK, call) \
        ALLOWED(state, result) \
        FORBIDDEN_LENGTH(x, call) \
    } \
    FORBIDDEN_DIM(function##_in)
    SYSTEM(sph_solve_cspm, sph_test_weights_cspm, sph_jet, sph_solve_cspm(dim, &m, x, &jet, 0), jet)
    SYSTEM(sph_solve_block, sph_test_weights_wls, sph_jet, sph_solve_block(dim, &m, x, &jet, 0), jet)
    jet = sph_jet_laplacian(3);
    SYSTEM(sph_coefficients_cspm, sph_test_weights_cspm, sph_coefficients,
           sph_coefficients_cspm(dim, &m, x, jet, &c, 0), c)
    SYSTEM(sph_coefficients_block, sph_test_weights_cspm, sph_coefficients,
           sph_coefficients_block(dim, 1, &m, x, jet, &c, 0), c)
    c = no_coefficients;
    FUNCTION(sph_coefficients_weight)
    ALLOWED(sph_real, sph_coefficients_weight(3, c, nothing, weights))
    FORBIDDEN(sph_coefficients_weight(0, c, nothing, weights))
    FUNCTION(sph_fit_zero)
    ALLOWED(sph_fit, sph_fit_zero())
    fit = sph_fit_zero();
    FUNCTION(sph_fit_add)
    ALLOWED(sph_fit, (sph_fit_add(3, &fit, nothing, weights), fit))
    FORBIDDEN((sph_fit_add(0, &fit, nothing, weights), 0))
    FUNCTION(sph_fit_add_value)
    ALLOWED(sph_fit, (sph_fit_add_value(3, &fit, nothing, weights, large), fit))
    FORBIDDEN((sph_fit_add_value(4, &fit, nothing, weights, one), 0))
    FUNCTION(sph_solve_fit)
    fit = sph_fit_zero();
    ALLOWED_STATE(SPH_SINGULAR, sph_solve_fit(3, &fit, one, &fit_rows, 0))
    for (dim = 1; dim <= 3; dim++) {
        fit = fit_cross(dim);
        x = SPH_R(0.01);
        ALLOWED_STATE(SPH_OK, sph_solve_fit(dim, &fit, x, &fit_rows, 0))
        ALLOWED(sph_fit_rows, fit_rows)
        FORBIDDEN_LENGTH(x, sph_solve_fit(dim, &fit, x, &fit_rows, 0))
    }
    FORBIDDEN(sph_solve_fit(0, &fit, one, &fit_rows, 0))
    FORBIDDEN(sph_solve_fit(4, &fit, one, &fit_rows, 0))
    FUNCTION(sph_fit_shepard)
    ALLOWED(sph_fit_rows, sph_fit_shepard(&fit))
    fit = sph_fit_zero();
    FORBIDDEN(sph_fit_shepard(&fit))
    FUNCTION(sph_fit_weight)
    ALLOWED(sph_real, sph_fit_weight(3, fit_rows.value, nothing, weights))
    FORBIDDEN(sph_fit_weight(0, fit_rows.value, nothing, weights))
    FUNCTION(sph_fit_value)
    ALLOWED(sph_real, sph_fit_value(3, fit_rows.value, &fit))
    FORBIDDEN(sph_fit_value(4, fit_rows.value, &fit))
    FUNCTION(sph_fit_extend)
    ALLOWED(sph_real, sph_fit_extend(3, large, nothing, nothing))
    FORBIDDEN(sph_fit_extend(0, one, nothing, nothing))
    FUNCTION(sph_boundary_weight_bim)
    ALLOWED(sph_real, sph_boundary_weight_bim(k0, SPH_R(1e-3), one, one))
    ALLOWED(sph_real, sph_boundary_weight_bim(k0, -large, -one, large))
    FORBIDDEN_LENGTH(x, sph_boundary_weight_bim(k0, x, one, one))
    FORBIDDEN(sph_boundary_weight_bim(k0, zero, -one, one))
    FORBIDDEN(sph_boundary_weight_bim(k0, one, -one, one))
    FORBIDDEN(sph_boundary_weight_bim(k0, one, SPH_R(2), one))
    FORBIDDEN_LENGTH(x, sph_boundary_weight_bim(k0, one, one, x))

    FUNCTION(sph_elliptic_gradient_pair_basic_degiuli_ban)
    ALLOWED(sph_kernel_gradient, sph_elliptic_gradient_pair_basic_degiuli_ban(large))
    FUNCTION(sph_elliptic_gradient_pair)
    ALLOWED(sph_kernel_gradient,
            sph_elliptic_gradient_pair(SPH_GRADIENT_DIFFUSE, wf(zero, zero), one, shepard(zero)))
    ALLOWED(sph_kernel_gradient,
            sph_elliptic_gradient_pair(SPH_GRADIENT_FULL, wf(zero, zero), one, shepard(small_number)))
    FORBIDDEN(sph_elliptic_gradient_pair(SPH_GRADIENT_FULL, wf(one, one), one, shepard(zero)))
    FORBIDDEN(sph_elliptic_gradient_pair(SPH_GRADIENT_SHEPARD_FULL, wf(one, one), one, shepard(zero)))
    FORBIDDEN(sph_elliptic_gradient_pair(4, wf(one, one), one, shepard(one)))
    FORBIDDEN(sph_elliptic_gradient_pair(-1, wf(one, one), one, shepard(one)))
    FUNCTION(sph_elliptic_gradient_vector)
    ALLOWED(sph_vec, sph_elliptic_gradient_vector(3, SPH_GRADIENT_FULL, nothing, no_gradient))
    FORBIDDEN(sph_elliptic_gradient_vector(3, 4, nothing, no_gradient))
    FORBIDDEN(sph_elliptic_gradient_vector(0, 0, nothing, no_gradient))
    FUNCTION(sph_elliptic_projection)
    ALLOWED(sph_real, sph_elliptic_projection(3, SPH_GRADIENT_FULL, nothing, no_gradient))
    FORBIDDEN(sph_elliptic_projection(3, -1, nothing, no_gradient))
    FORBIDDEN(sph_elliptic_projection(0, 0, nothing, no_gradient))
    FUNCTION(sph_mobility_pair)
    for (dim = 0; dim <= (int)SPH_MOBILITY_UPWIND; dim++)
        ALLOWED(sph_real, sph_mobility_pair(dim, zero, zero, zero))
    FORBIDDEN_BELOW_0(x, sph_mobility_pair(0, x, one, zero))
    FORBIDDEN_BELOW_0(x, sph_mobility_pair(1, one, x, zero))
    FORBIDDEN(sph_mobility_pair(3, one, one, zero))
    FORBIDDEN(sph_mobility_pair(-1, one, one, zero))
    FUNCTION(sph_elliptic_weight)
    ALLOWED(sph_real, sph_elliptic_weight(3, SPH_GRADIENT_FULL, nothing, no_gradient, no_correction, one))
    FORBIDDEN(sph_elliptic_weight(3, 4, nothing, no_gradient, no_correction, one))
    FORBIDDEN(sph_elliptic_weight(0, 0, nothing, no_gradient, no_correction, one))
    FUNCTION(sph_elliptic_moments_radial)
    ALLOWED(sph_elliptic_moments, sph_elliptic_moments_radial(sym(zero, zero), v))
    em = sph_elliptic_moments_radial(sym(zero, zero), v);
    FUNCTION(sph_mat_transposed)
    ALLOWED(sph_mat, sph_mat_transposed(3, no_inverse))
    FORBIDDEN(sph_mat_transposed(0, no_inverse))
    FUNCTION(sph_mat_of_sym)
    {
        const sph_sym none = {0};
        ALLOWED(sph_mat, sph_mat_of_sym(3, none))
        FORBIDDEN(sph_mat_of_sym(0, none))
    }
    FUNCTION(sph_mat_times)
    ALLOWED(sph_vec, sph_mat_times(3, no_inverse, v))
    FORBIDDEN(sph_mat_times(0, no_inverse, v))
    FUNCTION(sph_elliptic_invert)
    for (dim = 1; dim <= 3; dim++) {
        ALLOWED_STATE(SPH_SINGULAR, sph_elliptic_invert(dim, SPH_GRADIENT_FULL, &em, &inverse, 0))
        ALLOWED_STATE(SPH_SINGULAR, sph_elliptic_invert(dim, SPH_GRADIENT_DIFFUSE, &em, &inverse, 0))
    }
    FORBIDDEN_DIM(sph_elliptic_invert_in)
    FORBIDDEN(sph_elliptic_invert(3, 4, &em, &inverse, 0))
    FUNCTION(sph_sym_eigenvalues)
    ALLOWED(sph_vec, sph_sym_eigenvalues(3, sym(zero, small_number)))
    FORBIDDEN_DIM(sph_sym_eigenvalues_in)
}

/* the side of a Riemann problem with the impedance z, and a contact at rest */
static sph_riemann_side riemann(sph_real z)
{
    sph_riemann_side s;
    s.p = s.u = zero;
    s.z = z;
    return s;
}
static sph_riemann_star contact(void)
{
    sph_riemann_star s;
    s.p = s.u = s.viscous = zero;
    return s;
}

/* of a kernel for walls, the numbers alone: its knots */
typedef struct sph_wall_kernel_numbers {
    sph_real knot[5];
} sph_wall_kernel_numbers;
static sph_wall_kernel_numbers wall_kernel_numbers(sph_wall_kernel t)
{
    sph_wall_kernel_numbers n;
    memcpy(n.knot, t.knot, sizeof n.knot);
    return n;
}
/* a normal that is too short, and the sums of a curvature */
static sph_unit_normal direction(void)
{
    sph_unit_normal u;
    u.unit = vec(zero, zero, zero);
    u.good = zero;
    return u;
}
static sph_curvature_sums curvature(sph_real weight)
{
    sph_curvature_sums s;
    s.flux = zero;
    s.weight = weight;
    return s;
}

/* a function of two sides and numbers: what each side needs */
#define SIDES(call) \
    i = j = fluid(one, one, one, one); \
    FORBIDDEN_LENGTH(i.rho, call) \
    i.rho = one; \
    FORBIDDEN_LENGTH(j.rho, call) \
    j.rho = one;

static void fluids(void)
{
    const sph_viscosity_terms terms = {SPH_R(1), SPH_R(2), SPH_R(0)};
    const sph_vec nothing = vec(zero, zero, zero);
    sph_fluid_side i, j;
    sph_encounter e;
    sph_real x;
    i = j = fluid(one, small_number, -one, zero);
    FUNCTION(sph_pressure_pair_monaghan)
    ALLOWED(sph_real, sph_pressure_pair_monaghan(i, j))
    SIDES(sph_pressure_pair_monaghan(i, j))
    FUNCTION(sph_pressure_pair_colagrossi)
    ALLOWED(sph_real, sph_pressure_pair_colagrossi(i, j))
    SIDES(sph_pressure_pair_colagrossi(i, j))
    FUNCTION(sph_pressure_pair_hu_adams)
    ALLOWED(sph_real, sph_pressure_pair_hu_adams(i, j))
    SIDES(sph_pressure_pair_hu_adams(i, j))
    FORBIDDEN_LENGTH(i.m, sph_pressure_pair_hu_adams(i, j))
    i.m = one;
    FORBIDDEN_LENGTH(j.m, sph_pressure_pair_hu_adams(i, j))
#define ARTIFICIAL(function) \
    FUNCTION(function) \
    ALLOWED(sph_real, function(terms, meeting(zero, zero, small_number, zero, small_number))) \
    ALLOWED(sph_real, function(terms, meeting(-one, large, small_number, large, one))) \
    FORBIDDEN_BELOW_0(x, function(terms, meeting(-one, x, one, one, one))) \
    FORBIDDEN_BELOW_0(x, function(terms, meeting(-one, one, one, x, one))) \
    FORBIDDEN_LENGTH(x, function(terms, meeting(-one, one, one, one, x)))
    ARTIFICIAL(sph_viscosity_pair_monaghan)
    FORBIDDEN_LENGTH(x, sph_viscosity_pair_monaghan(terms, meeting(-one, one, x, one, one)))
    ARTIFICIAL(sph_viscosity_pair_linear)
    FORBIDDEN_LENGTH(x, sph_viscosity_pair_linear(terms, meeting(-one, one, x, one, one)))
    ARTIFICIAL(sph_viscosity_pair_signal)
    /* h is not read */
    ALLOWED(sph_real, sph_viscosity_pair_signal(terms, meeting(-one, one, zero, one, one)))
    FUNCTION(sph_signal_speed)
    ALLOWED(sph_real, sph_signal_speed(zero, zero, zero))
    FORBIDDEN(sph_signal_speed(-one, one, one))
    FORBIDDEN(sph_signal_speed(one, -one, one))
    FUNCTION(sph_viscosity_signal)
    ALLOWED(sph_real, sph_viscosity_signal(one, -one, zero))
    FORBIDDEN_BELOW_0(x, sph_viscosity_signal(one, one, x))
#define PHYSICAL(call) \
    i = j = fluid(one, one, zero, zero); \
    e = meeting(-one, zero, small_number, zero, zero); \
    ALLOWED(sph_real, call) /* no viscosity, one place */ \
    SIDES(call) \
    FORBIDDEN_BELOW_0(i.mu, call) \
    i.mu = one; \
    FORBIDDEN_BELOW_0(j.mu, call) \
    j.mu = one; \
    FORBIDDEN_BELOW_0(e.r, call) \
    e.r = one; \
    FORBIDDEN_LENGTH(e.h, call)
    FUNCTION(sph_viscosity_mu_pair_morris)
    PHYSICAL(sph_viscosity_mu_pair_morris(i, j, e, -one, zero))
    FUNCTION(sph_viscosity_mu_pair_espanol_revenga)
    i = fluid(one, one, zero, zero);
    j = fluid(one, one, zero, one);
    ALLOWED(sph_viscosity_force,
            sph_viscosity_mu_pair_espanol_revenga(3, i, j, bulk(zero, zero), meeting(one, one, one, one, one), -one, zero))
    FORBIDDEN_BELOW_0(x, sph_viscosity_mu_pair_espanol_revenga(3, i, j, bulk(x, one), meeting(one, one, one, one, one), -one, zero))
    FORBIDDEN_BELOW_0(i.mu, sph_viscosity_mu_pair_espanol_revenga(3, i, j, bulk(one, one), meeting(one, one, one, one, one), -one, zero))
    i = fluid(one, one, zero, one);
    FORBIDDEN_BELOW_0(x, sph_viscosity_mu_pair_espanol_revenga(3, i, j, bulk(one, x), meeting(one, one, one, one, one), -one, zero))
    FORBIDDEN_LENGTH(i.rho, sph_viscosity_mu_pair_espanol_revenga(3, i, j, bulk(one, one), meeting(one, one, one, one, one), -one, zero))
    i = fluid(one, one, zero, one);
    FORBIDDEN(sph_viscosity_mu_pair_espanol_revenga(0, i, j, bulk(one, one), meeting(one, one, one, one, one), -one, zero))
    FUNCTION(sph_viscosity_mu_pair_monaghan_cleary)
    PHYSICAL(sph_viscosity_mu_pair_monaghan_cleary(3, i, j, e, -one, zero))
    FORBIDDEN(sph_viscosity_mu_pair_monaghan_cleary(0, i, j, meeting(one, one, one, one, one), -one, zero))
    FUNCTION(sph_density_rate_pair_mass)
    ALLOWED(sph_real, sph_density_rate_pair_mass(fluid(zero, zero, zero, zero), one, -one))
    FUNCTION(sph_density_rate_pair_volume)
    i = fluid(one, small_number, zero, zero);
    ALLOWED(sph_real, sph_density_rate_pair_volume(i, fluid(one, one, zero, zero), one, -one))
    SIDES(sph_density_rate_pair_volume(i, j, one, -one))
#define WHOLE(function) \
    FUNCTION(function) \
    i = j = fluid(one, one, -one, zero); \
    ALLOWED(sph_fluid_change, function(i, j, nothing, zero, zero, zero)) \
    SIDES(function(i, j, nothing, zero, zero, zero))
    WHOLE(sph_fluid_pair_monaghan)
    WHOLE(sph_fluid_pair_colagrossi)
    WHOLE(sph_fluid_pair_hu_adams)
    FORBIDDEN_LENGTH(j.m, sph_fluid_pair_hu_adams(i, j, nothing, zero, zero, zero))
    FUNCTION(sph_velocity_pair_xsph)
    ALLOWED(sph_real, sph_velocity_pair_xsph(i, fluid(zero, small_number, zero, zero), zero))
    SIDES(sph_velocity_pair_xsph(i, j, one))

    FUNCTION(sph_riemann_side_of)
    i = fluid(zero, small_number, -one, zero);
    ALLOWED(sph_riemann_side, sph_riemann_side_of(i, small_number, meeting(zero, zero, zero, zero, zero), -one))
    i = fluid(one, one, one, one);
    FORBIDDEN_LENGTH(i.rho, sph_riemann_side_of(i, one, meeting(one, one, one, one, one), one))
    i.rho = one;
    FORBIDDEN_LENGTH(x, sph_riemann_side_of(i, x, meeting(one, one, one, one, one), one))
    FORBIDDEN_BELOW_0(x, sph_riemann_side_of(i, one, meeting(one, x, one, one, one), one))
    FUNCTION(sph_riemann_beta)
    ALLOWED(sph_real, sph_riemann_beta(riemann(small_number), riemann(small_number), small_number, zero))
    FORBIDDEN_LENGTH(x, sph_riemann_beta(riemann(x), riemann(one), one, one))
    FORBIDDEN_LENGTH(x, sph_riemann_beta(riemann(one), riemann(x), one, one))
    FORBIDDEN_LENGTH(x, sph_riemann_beta(riemann(one), riemann(one), x, one))
    FORBIDDEN_BELOW_0(x, sph_riemann_beta(riemann(one), riemann(one), one, x))
    FUNCTION(sph_riemann_rest)
    ALLOWED(sph_real, sph_riemann_rest(3, zero, nothing, nothing))
    FORBIDDEN(sph_riemann_rest(0, one, nothing, nothing))
    FUNCTION(sph_riemann_acoustic)
    ALLOWED(sph_riemann_star, sph_riemann_acoustic(riemann(small_number), riemann(small_number), zero, zero))
    FORBIDDEN_LENGTH(x, sph_riemann_acoustic(riemann(x), riemann(one), one, zero))
    FORBIDDEN_LENGTH(x, sph_riemann_acoustic(riemann(one), riemann(x), one, zero))
    FUNCTION(sph_fluid_pair_riemann)
    i = j = fluid(one, one, -one, zero);
    ALLOWED(sph_fluid_change,
            sph_fluid_pair_riemann(i, j, contact(), nothing, meeting(zero, zero, zero, zero, zero), zero))
    SIDES(sph_fluid_pair_riemann(i, j, contact(), nothing, meeting(one, one, one, one, one), zero))

    FUNCTION(sph_rk_moments_pair)
    ALLOWED(sph_rk_moments, sph_rk_moments_pair(3, zero, nothing, wf(zero, zero)))
    FORBIDDEN(sph_rk_moments_pair(0, one, nothing, wf(one, -one)))
    FUNCTION(sph_rk_solve)
    {
        const sph_rk_moments none = {0};
        sph_rk_side side;
        sph_real conditioning;
        ALLOWED_STATE(SPH_TOO_FEW, sph_rk_solve(3, none, &side, &conditioning))
        ALLOWED_STATE(SPH_FELL_BACK, sph_rk_solve(3, sph_rk_moments_pair(3, one, nothing, wf(one, zero)), &side, &conditioning))
        FORBIDDEN(sph_rk_solve(4, sph_rk_moments_pair(3, one, nothing, wf(one, zero)), &side, &conditioning))
        FUNCTION(sph_rk_pair)
        ALLOWED(sph_rk_kernel, sph_rk_pair(3, side, nothing, wf(one, zero)))
        FORBIDDEN(sph_rk_pair(0, side, nothing, wf(one, zero)))
        FUNCTION(sph_rk_pair_difference)
        ALLOWED(sph_vec, sph_rk_pair_difference(3, side, side, nothing, wf(one, zero), wf(one, zero)))
        FORBIDDEN(sph_rk_pair_difference(0, side, side, nothing, wf(one, zero), wf(one, zero)))
    }
    FUNCTION(sph_gradient_pair_iad)
    ALLOWED(sph_vec, sph_gradient_pair_iad(3, no_inverse, nothing, zero))
    FORBIDDEN(sph_gradient_pair_iad(0, no_inverse, nothing, one))
    FUNCTION(sph_gas_pair_crk)
    i = j = fluid(one, zero, -one, zero);
    ALLOWED(sph_corrected_change, sph_gas_pair_crk(3, i, j, zero, nothing, nothing, zero))
    FORBIDDEN_LENGTH(x, sph_gas_pair_crk(3, fluid(x, one, one, zero), j, one, nothing, nothing, zero))
    FORBIDDEN(sph_gas_pair_crk(0, i, j, one, nothing, nothing, zero))
    FUNCTION(sph_gas_pair_iad)
    i = j = fluid(zero, one, -one, zero);
    ALLOWED(sph_corrected_change, sph_gas_pair_iad(3, i, j, nothing, nothing, nothing, zero))
    SIDES(sph_gas_pair_iad(3, i, j, nothing, nothing, nothing, zero))
    FORBIDDEN(sph_gas_pair_iad(0, i, j, nothing, nothing, nothing, zero))
    {
        const sph_elastic soft = {SPH_R(0), SPH_R(0)};
        sph_elastic wrong = {SPH_R(1), SPH_R(-1)};
        sph_mat f = no_inverse, turned;
        sph_solid_side body = {0};
        sph_pair_kernel apart = {0};
        FUNCTION(sph_elastic_of)
        ALLOWED(sph_elastic, sph_elastic_of(zero, SPH_R(-0.99)))
        ALLOWED(sph_elastic, sph_elastic_of(one, SPH_R(0.49)))
        FORBIDDEN_BELOW_0(x, sph_elastic_of(x, zero))
        FORBIDDEN(sph_elastic_of(one, SPH_R(0.5)))
        FORBIDDEN(sph_elastic_of(one, -one))
        FUNCTION(sph_sound_speed_elastic)
        ALLOWED(sph_real, sph_sound_speed_elastic(soft, small_number))
        FORBIDDEN(sph_sound_speed_elastic(wrong, one))
        FORBIDDEN_LENGTH(x, sph_sound_speed_elastic(soft, x))
        FUNCTION(sph_stress_saint_venant_kirchhoff)
        ALLOWED(sph_mat, sph_stress_saint_venant_kirchhoff(3, f, soft))
        FORBIDDEN(sph_stress_saint_venant_kirchhoff(0, f, soft))
        f.x.x = f.y.y = f.z.z = one;
        turned = f;
        turned.x.x = -one;
        FUNCTION(sph_stress_neo_hookean)
        ALLOWED(sph_mat, sph_stress_neo_hookean(3, f, soft))
        FORBIDDEN(sph_stress_neo_hookean(3, turned, soft))
        FORBIDDEN(sph_stress_neo_hookean(3, no_inverse, soft))
        FORBIDDEN(sph_stress_neo_hookean(4, f, soft))
        FUNCTION(sph_deformation_pair)
        ALLOWED(sph_mat, sph_deformation_pair(3, one, nothing, nothing, zero))
        FORBIDDEN(sph_deformation_pair(0, one, nothing, nothing, zero))
        FUNCTION(sph_deformation_value)
        ALLOWED(sph_mat, sph_deformation_value(3, f, no_inverse))
        FORBIDDEN(sph_deformation_value(0, f, no_inverse))
        FUNCTION(sph_stress_pair)
        ALLOWED(sph_vec, sph_stress_pair(3, body, body, one, nothing, apart))
        FORBIDDEN(sph_stress_pair(0, body, body, one, nothing, apart))
        FUNCTION(sph_hourglass_pair)
        ALLOWED(sph_vec, sph_hourglass_pair(3, body, body, one, nothing, nothing, apart))
        FORBIDDEN(sph_hourglass_pair(0, body, body, one, nothing, nothing, apart))
    }
    FUNCTION(sph_unit_normal_of)
    ALLOWED(sph_unit_normal, sph_unit_normal_of(3, nothing, zero))
    ALLOWED(sph_unit_normal, sph_unit_normal_of(3, vec(small_number, zero, zero), zero))
    FORBIDDEN_BELOW_0(x, sph_unit_normal_of(3, nothing, x))
    FORBIDDEN(sph_unit_normal_of(0, nothing, one))
    FUNCTION(sph_curvature_pair)
    ALLOWED(sph_curvature_sums, sph_curvature_pair(3, direction(), direction(), zero, nothing, zero))
    FORBIDDEN(sph_curvature_pair(4, direction(), direction(), one, nothing, one))
    FUNCTION(sph_curvature_value)
    ALLOWED(sph_real, sph_curvature_value(3, curvature(small_number)))
    FORBIDDEN_LENGTH(x, sph_curvature_value(3, curvature(x)))
    FORBIDDEN(sph_curvature_value(0, curvature(one)))
    FUNCTION(sph_tension_csf_value)
    ALLOWED(sph_vec, sph_tension_csf_value(zero, one, nothing, small_number))
    FORBIDDEN_LENGTH(x, sph_tension_csf_value(one, one, nothing, x))
    FUNCTION(sph_tension_stress_times)
    ALLOWED(sph_vec, sph_tension_stress_times(3, nothing, nothing))
    FORBIDDEN(sph_tension_stress_times(0, nothing, nothing))
    FUNCTION(sph_tension_pair_css)
    ALLOWED(sph_vec, sph_tension_pair_css(3, one, nothing, nothing, zero, nothing, zero))
    FORBIDDEN(sph_tension_pair_css(0, one, nothing, nothing, zero, nothing, zero))
    FUNCTION(sph_tension_pair_akinci)
    i = j = fluid(zero, one, zero, zero);
    ALLOWED(sph_vec, sph_tension_pair_akinci(i, j, nothing, nothing, zero, one, one))
    SIDES(sph_tension_pair_akinci(i, j, nothing, nothing, zero, one, one))
    FORBIDDEN_LENGTH(x, sph_tension_pair_akinci(i, j, nothing, nothing, one, x, one))
    FORBIDDEN_BELOW_0(x, sph_tension_pair_akinci(i, j, nothing, nothing, x, one, one))

    {
        const sph_wall_kernel points = sph_wall_kernel_of(SPH_WENDLAND_C6, 1),
                              segments = sph_wall_kernel_of(SPH_WENDLAND_C6, 2),
                              triangles = sph_wall_kernel_of(SPH_WENDLAND_C6, 3),
                              none = sph_wall_kernel_of(SPH_GAUSSIAN, 1);
        FUNCTION(sph_wall_kernel_of)
        ALLOWED(sph_wall_kernel_numbers, wall_kernel_numbers(sph_wall_kernel_of(SPH_GAUSSIAN, 1)))
        FORBIDDEN(sph_wall_kernel_of(SPH_KERNEL_COUNT, 1))
        FORBIDDEN(sph_wall_kernel_of(SPH_SPIKY, 4))
        FUNCTION(sph_wall_point)
        ALLOWED(sph_wall_part, sph_wall_point(&points, zero, one, one))
        FORBIDDEN(sph_wall_point(&segments, one, one, one))
        FORBIDDEN(sph_wall_point(&none, one, one, one))
        FORBIDDEN_LENGTH(x, sph_wall_point(&points, one, one, x))
        FUNCTION(sph_wall_segment)
        ALLOWED(sph_wall_part, sph_wall_segment(&segments, nothing, nothing, one))
        ALLOWED(sph_wall_part, sph_wall_segment(&segments, nothing, vec(one, zero, zero), one))
        FORBIDDEN(sph_wall_segment(&points, nothing, nothing, one))
        FORBIDDEN_LENGTH(x, sph_wall_segment(&segments, nothing, nothing, x))
        FUNCTION(sph_wall_triangle)
        ALLOWED(sph_wall_part, sph_wall_triangle(&triangles, nothing, nothing, nothing, one))
        ALLOWED(sph_wall_part,
                sph_wall_triangle(&triangles, nothing, vec(one, zero, zero), vec(zero, one, zero), one))
        FORBIDDEN(sph_wall_triangle(&points, nothing, nothing, nothing, one))
        FORBIDDEN_LENGTH(x, sph_wall_triangle(&triangles, nothing, nothing, nothing, x))
    }
    FUNCTION(sph_wall_gradient_value)
    ALLOWED(sph_vec, sph_wall_gradient_value(3, nothing, zero, small_number, nothing))
    FORBIDDEN_LENGTH(x, sph_wall_gradient_value(3, nothing, one, x, nothing))
    FUNCTION(sph_wall_laplacian_value)
    ALLOWED(sph_real, sph_wall_laplacian_value(3, zero, nothing, small_number, nothing))
    FORBIDDEN_LENGTH(x, sph_wall_laplacian_value(3, one, nothing, x, nothing))

    FUNCTION(sph_wall_pair_adami)
    i = fluid(zero, zero, zero, zero);
    ALLOWED(sph_wall_sums, sph_wall_pair_adami(2, i, nothing, nothing, nothing, zero))
    FORBIDDEN(sph_wall_pair_adami(0, i, nothing, nothing, nothing, one))
    FUNCTION(sph_wall_pressure)
    ALLOWED(sph_real, sph_wall_pressure(wall_sums(small_number)))
    FORBIDDEN_LENGTH(x, sph_wall_pressure(wall_sums(x)))
    FUNCTION(sph_wall_fluid_velocity)
    ALLOWED(sph_vec, sph_wall_fluid_velocity(wall_sums(small_number)))
    FORBIDDEN_LENGTH(x, sph_wall_fluid_velocity(wall_sums(x)))
    FUNCTION(sph_wall_row_weight)
    ALLOWED(sph_real, sph_wall_row_weight(zero, wall_sums(small_number)))
    FORBIDDEN_LENGTH(x, sph_wall_row_weight(one, wall_sums(x)))
    FUNCTION(sph_wall_mirror)
    ALLOWED(sph_vec, sph_wall_mirror(3, nothing, nothing, nothing))
    FORBIDDEN(sph_wall_mirror(0, nothing, nothing, nothing))
    FUNCTION(sph_wall_velocity_no_slip)
    ALLOWED(sph_vec, sph_wall_velocity_no_slip(3, nothing, nothing))
    FORBIDDEN(sph_wall_velocity_no_slip(0, nothing, nothing))
    FUNCTION(sph_wall_velocity_free_slip)
    ALLOWED(sph_vec, sph_wall_velocity_free_slip(3, nothing, nothing, nothing))
    FORBIDDEN(sph_wall_velocity_free_slip(4, nothing, nothing, nothing))

#define TAIT(function, of) \
    FORBIDDEN_LENGTH(x, function(of, tait(x, one, SPH_R(7)))) \
    FORBIDDEN_BELOW_0(x, function(of, tait(one, x, SPH_R(7)))) \
    FORBIDDEN_LENGTH(x, function(of, tait(one, one, x)))
    FUNCTION(sph_pressure_tait)
    ALLOWED(sph_real, sph_pressure_tait(zero, tait(one, zero, SPH_R(0.5))))
    FORBIDDEN_BELOW_0(x, sph_pressure_tait(x, tait(one, one, SPH_R(7))))
    TAIT(sph_pressure_tait, one)
    FUNCTION(sph_density_tait)
    ALLOWED(sph_real, sph_density_tait(-large, tait(one, one, one)))
    FORBIDDEN(sph_density_tait(not_a_number, tait(one, one, SPH_R(7))))
    FORBIDDEN(sph_density_tait(infinite, tait(one, one, SPH_R(7))))
    FORBIDDEN(sph_density_tait(one, tait(one, zero, SPH_R(7))))
    TAIT(sph_density_tait, one)
    FUNCTION(sph_sound_speed_tait)
    ALLOWED(sph_real, sph_sound_speed_tait(zero, tait(one, zero, one)))
    ALLOWED(sph_real, sph_sound_speed_tait(small_number, tait(one, one, SPH_R(0.5))))
    FORBIDDEN_BELOW_0(x, sph_sound_speed_tait(x, tait(one, one, SPH_R(7))))
    FORBIDDEN(sph_sound_speed_tait(zero, tait(one, one, SPH_R(0.5))))
    TAIT(sph_sound_speed_tait, one)

    FUNCTION(sph_time_step_sound)
    ALLOWED(sph_real, sph_time_step_sound(small_number, zero, zero))
    ALLOWED(sph_real, sph_time_step_sound(large, zero, small_number))
    FORBIDDEN_LENGTH(x, sph_time_step_sound(x, one, one))
    FORBIDDEN_BELOW_0(x, sph_time_step_sound(one, x, one))
    FORBIDDEN_BELOW_0(x, sph_time_step_sound(one, one, x))
    FUNCTION(sph_time_step_force)
    ALLOWED(sph_real, sph_time_step_force(small_number, zero))
    FORBIDDEN_LENGTH(x, sph_time_step_force(x, one))
    FORBIDDEN_BELOW_0(x, sph_time_step_force(one, x))
    /* not the answer that nothing limits the step */
    CHECK(!sphi_finite(sph_time_step_force(one, not_a_number)));
    FUNCTION(sph_time_step_viscous_nu)
    ALLOWED(sph_real, sph_time_step_viscous_nu(small_number, zero))
    FORBIDDEN_LENGTH(x, sph_time_step_viscous_nu(x, one))
    FORBIDDEN_BELOW_0(x, sph_time_step_viscous_nu(one, x))

    FUNCTION(sph_collision_pair)
    ALLOWED(sph_real, sph_collision_pair(zero, impact(zero, small_number, small_number)))
    FORBIDDEN_BELOW_0(x, sph_collision_pair(x, impact(one, one, one)))
    FORBIDDEN_BELOW_0(x, sph_collision_pair(one, impact(x, one, one)))
    FORBIDDEN_BELOW_0(x, sph_collision_pair(one, impact(one, x, one)))
    FORBIDDEN(sph_collision_pair(one, impact(zero, zero, one)))
    FORBIDDEN_LENGTH(x, sph_collision_pair(one, impact(one, one, x)))
}

static sph_transport_side carried(sph_real m, sph_real rho)
{
    const sph_transport_side s = {m, rho, vec(one, one, one), vec(one, -one, one)};
    return s;
}
static void liquids(void)
{
    const sph_shift_along drifts = {large, zero};
    const sph_vec nothing = vec(zero, zero, zero), along = vec(one, one, one);
    sph_real x;
    FUNCTION(sph_density_difference_molteni)
    ALLOWED(sph_real, sph_density_difference_molteni(fluid(zero, zero, zero, zero), fluid(zero, large, zero, zero)))
    FUNCTION(sph_density_difference_antuono)
    ALLOWED(sph_real, sph_density_difference_antuono(3, fluid(zero, zero, zero, zero), fluid(zero, large, zero, zero), along, nothing, along))
    FORBIDDEN(sph_density_difference_antuono(0, fluid(one, one, one, one), fluid(one, one, one, one), along, along, along))
    FUNCTION(sph_density_difference_fourtakas)
    ALLOWED(sph_real, sph_density_difference_fourtakas(3, fluid(zero, zero, zero, zero), fluid(zero, large, zero, zero), nothing, along))
    FORBIDDEN(sph_density_difference_fourtakas(4, fluid(one, one, one, one), fluid(one, one, one, one), along, along))
    FUNCTION(sph_density_slope)
    ALLOWED(sph_vec, sph_density_slope(tait(small_number, one, zero), along))
    FORBIDDEN_LENGTH(x, sph_density_slope(tait(x, one, one), along))
    FORBIDDEN_LENGTH(x, sph_density_slope(tait(one, x, one), along))
    FUNCTION(sph_density_diffusion_weight)
    ALLOWED(sph_real, sph_density_diffusion_weight(zero, zero, -one))
    FUNCTION(sph_time_step_density_diffusion)
    ALLOWED(sph_real, sph_time_step_density_diffusion(SPH_WENDLAND_C2, 3, small_number, zero, zero))
    FORBIDDEN(sph_time_step_density_diffusion(SPH_WENDLAND_C2, 0, one, one, one))
    FORBIDDEN_LENGTH(x, sph_time_step_density_diffusion(SPH_WENDLAND_C2, 1, x, one, one))
    FORBIDDEN_BELOW_0(x, sph_time_step_density_diffusion(SPH_WENDLAND_C2, 2, one, x, one))
    FORBIDDEN_BELOW_0(x, sph_time_step_density_diffusion(SPH_WENDLAND_C2, 3, one, one, x))
    FUNCTION(sph_sym_least_eigenvalue)
    ALLOWED(sph_real, sph_sym_least_eigenvalue(3, sym(zero, zero)))
    ALLOWED(sph_real, sph_sym_least_eigenvalue(3, sym(one, small_number)))
    FORBIDDEN(sph_sym_least_eigenvalue(0, sym(one, zero)))
    FUNCTION(sph_surface_of)
    ALLOWED_STATE(SPH_SURFACE_SPLASH, sph_surface_of(-large))
    ALLOWED_STATE(SPH_SURFACE_BAND, sph_surface_of(SPH_R(0.5)))
    ALLOWED_STATE(SPH_SURFACE_INSIDE, sph_surface_of(large))
    FUNCTION(sph_surface_normal)
    ALLOWED(sph_vec, sph_surface_normal(3, sym(one, zero), nothing, small_number))
    FORBIDDEN(sph_surface_normal(0, sym(one, zero), along, one))
    FORBIDDEN_LENGTH(x, sph_surface_normal(3, sym(one, zero), along, x))
    FUNCTION(sph_surface_covers)
    ALLOWED_STATE(0, sph_surface_covers(3, nothing, nothing, small_number))
    FORBIDDEN(sph_surface_covers(4, along, along, one))
    FORBIDDEN_LENGTH(x, sph_surface_covers(2, along, along, x))
    FUNCTION(sph_shift_pair)
    ALLOWED(sph_vec, sph_shift_pair(-one, -one, nothing, -one, zero))
    FUNCTION(sph_shift_strength_skillen)
    ALLOWED(sph_real, sph_shift_strength_skillen(zero, zero, zero))
    FUNCTION(sph_shift_strength_sun)
    ALLOWED(sph_real, sph_shift_strength_sun(zero, zero, small_number))
    FORBIDDEN_LENGTH(x, sph_shift_strength_sun(one, one, x))
    FUNCTION(sph_shift_at_surface)
    ALLOWED(sph_vec, sph_shift_at_surface(3, along, SPH_R(0.5), nothing))
    FORBIDDEN(sph_shift_at_surface(0, along, SPH_R(0.5), along))
    FUNCTION(sph_shift_limited)
    ALLOWED(sph_vec, sph_shift_limited(3, nothing, zero))
    FORBIDDEN(sph_shift_limited(4, along, one))
    FORBIDDEN_BELOW_0(x, sph_shift_limited(3, along, x))
    FUNCTION(sph_shift_rate_pair)
    ALLOWED(sph_real, sph_shift_rate_pair(drifts, -one, zero))
    FUNCTION(sph_pressure_factor_pair_dfsph)
    ALLOWED(sph_dfsph_sums, sph_pressure_factor_pair_dfsph(3, zero, zero, nothing, zero))
    FORBIDDEN(sph_pressure_factor_pair_dfsph(0, one, one, along, -one))
    FUNCTION(sph_pressure_factor_value_dfsph)
    ALLOWED(sph_real, sph_pressure_factor_value_dfsph(3, fluid(one, one, zero, zero), sph_pressure_factor_pair_dfsph(3, one, one, along, -one)))
    FORBIDDEN(sph_pressure_factor_value_dfsph(4, fluid(one, one, zero, zero), sph_pressure_factor_pair_dfsph(3, one, one, along, -one)))
    FUNCTION(sph_transport_pair_adami)
    ALLOWED(sph_transport_change, sph_transport_pair_adami(3, carried(one, small_number), carried(small_number, one), nothing, zero))
    FORBIDDEN(sph_transport_pair_adami(0, carried(one, one), carried(one, one), along, -one))
    FORBIDDEN_LENGTH(x, sph_transport_pair_adami(2, carried(x, one), carried(one, one), along, -one))
    FORBIDDEN_LENGTH(x, sph_transport_pair_adami(2, carried(one, x), carried(one, one), along, -one))
    FORBIDDEN_LENGTH(x, sph_transport_pair_adami(2, carried(one, one), carried(x, one), along, -one))
    FORBIDDEN_LENGTH(x, sph_transport_pair_adami(2, carried(one, one), carried(one, x), along, -one))
}

static void magnetised_gas(void)
{
    const sph_vec nothing = vec(zero, zero, zero), field = vec(one, SPH_R(2), SPH_R(2));
    const sph_mhd_sums no_sums = {0};
    const sph_gas_sums no_gas_sums = {0};
    const sph_velocity_gradient no_slope = {nothing, nothing, nothing};
    const sph_gas_terms gas_terms = {SPH_R(2), SPH_R(1), SPH_CONDUCTIVITY_PRICE};
    sph_pair_weights w = {SPH_R(1), SPH_R(1)};
    sph_real x;
    FUNCTION(sph_mhd_traction)
    ALLOWED(sph_vec, sph_mhd_traction(nothing, -one, zero, nothing))
    FUNCTION(sph_mhd_fast_speed)
    ALLOWED(sph_real, sph_mhd_fast_speed(zero, nothing, small_number, zero))
    ALLOWED(sph_real, sph_mhd_fast_speed(one, field, one, SPH_R(-3)))
    FORBIDDEN_LENGTH(x, sph_mhd_fast_speed(one, field, x, zero))
    FORBIDDEN(sph_mhd_fast_speed(one, field, one, SPH_R(3.001)))
    FORBIDDEN(sph_mhd_fast_speed(one, field, one, not_a_number))
    FUNCTION(sph_conductivity_speed)
    ALLOWED(sph_real, sph_conductivity_speed(-one, one, zero))
    FORBIDDEN_BELOW_0(x, sph_conductivity_speed(one, zero, x))
#define WAVE(call) \
    FORBIDDEN_BELOW_0(of.ch, call) \
    of.ch = zero; \
    FORBIDDEN_BELOW_0(of.sigma, call) \
    of.sigma = zero; \
    FORBIDDEN_LENGTH(of.h, call) \
    of.h = small_number; \
    ALLOWED(sph_real, call)
    {
        sph_cleaning_wave of = wave(one, one, one);
        FUNCTION(sph_cleaning_rate)
        WAVE(sph_cleaning_rate(of, one, one, one))
        of = wave(one, one, one);
        FUNCTION(sph_cleaning_rate_scaled)
        WAVE(sph_cleaning_rate_scaled(of, one, one, one))
        of = wave(one, one, one);
        FUNCTION(sph_cleaning_rate_velocity)
        WAVE(sph_cleaning_rate_velocity(of, one, one))
    }
    FUNCTION(sph_cleaning_sigma)
    ALLOWED(sph_real, sph_cleaning_sigma(1))
    FORBIDDEN(sph_cleaning_sigma(0))
    FORBIDDEN(sph_cleaning_sigma(4))
    FUNCTION(sph_euler_potentials)
    ALLOWED(sph_vec, sph_euler_potentials(nothing, field))
    FUNCTION(sph_viscosity_switch_rate)
    ALLOWED(sph_real, sph_viscosity_switch_rate(bounds(one, one), zero, small_number, zero))
    FORBIDDEN(sph_viscosity_switch_rate(bounds(one, zero), one, one, zero))
    FORBIDDEN_BELOW_0(x, sph_viscosity_switch_rate(bounds(zero, one), x, one, zero))
    FORBIDDEN_LENGTH(x, sph_viscosity_switch_rate(bounds(zero, one), one, x, zero))
    FUNCTION(sph_resistivity_switch)
    ALLOWED(sph_real, sph_resistivity_switch(small_number, zero, zero))
    FORBIDDEN_LENGTH(x, sph_resistivity_switch(x, one, one))
    FORBIDDEN_BELOW_0(x, sph_resistivity_switch(one, x, one))
    FORBIDDEN_BELOW_0(x, sph_resistivity_switch(one, one, x))

    FUNCTION(sph_medium_weight)
    ALLOWED(sph_real, sph_medium_weight(medium(small_number, small_number)))
    FORBIDDEN_LENGTH(x, sph_medium_weight(medium(x, one)))
    FORBIDDEN_LENGTH(x, sph_medium_weight(medium(one, x)))
    FUNCTION(sph_pair_weights_of)
    ALLOWED(sph_pair_weights, sph_pair_weights_of(zero, pair_kernel(zero), one, one))
    FUNCTION(sph_divergence_pair_difference)
    ALLOWED(sph_real, sph_divergence_pair_difference(1, zero, field, field))
    FORBIDDEN(sph_divergence_pair_difference(0, one, field, field))
    FUNCTION(sph_curl_pair_difference)
    ALLOWED(sph_vec, sph_curl_pair_difference(zero, field, nothing))
    FUNCTION(sph_medium_difference)
    ALLOWED(sph_real, sph_medium_difference(medium(small_number, small_number), one))
    FORBIDDEN_LENGTH(x, sph_medium_difference(medium(x, one), one))
    FORBIDDEN_LENGTH(x, sph_medium_difference(medium(one, x), one))
    FUNCTION(sph_divergence_pair_symmetric)
    ALLOWED(sph_real, sph_divergence_pair_symmetric(3, w, field, field, nothing))
    FORBIDDEN(sph_divergence_pair_symmetric(0, w, field, field, nothing))
    FUNCTION(sph_gradient_pair_symmetric)
    ALLOWED(sph_vec, sph_gradient_pair_symmetric(w, one, -one, nothing))
    FUNCTION(sph_induction_pair)
    ALLOWED(sph_vec, sph_induction_pair(zero, one, nothing))
    FUNCTION(sph_resistivity_pair)
    ALLOWED(sph_real, sph_resistivity_pair(zero, one, one))
    FUNCTION(sph_resistivity_pair_ohmic)
    {
        sph_ohmic_pair eta = {0};
        ALLOWED(sph_real, sph_resistivity_pair_ohmic(medium(small_number, one), medium(one, one), eta, zero))
        FORBIDDEN_LENGTH(x, sph_resistivity_pair_ohmic(medium(x, one), medium(one, one), eta, one))
        FORBIDDEN_LENGTH(x, sph_resistivity_pair_ohmic(medium(one, one), medium(x, one), eta, one))
        eta.j = -one;
        FORBIDDEN(sph_resistivity_pair_ohmic(medium(one, one), medium(one, one), eta, one))
    }
    FUNCTION(sph_resistivity_heat)
    ALLOWED(sph_real, sph_resistivity_heat(zero, nothing))
    FUNCTION(sph_time_step_resistivity)
    ALLOWED(sph_real, sph_time_step_resistivity(small_number, zero))
    FORBIDDEN_LENGTH(x, sph_time_step_resistivity(x, one))
    FORBIDDEN_BELOW_0(x, sph_time_step_resistivity(one, x))

#define GAS(i, j, r) sph_gas_pair(2, gas_terms, i, j, pair_kernel(r), nothing)
    FUNCTION(sph_gas_pair)
    ALLOWED(sph_gas_sums, GAS(plain(one, one), plain(small_number, one), zero))
    ALLOWED(sph_gas_sums, GAS(plain(one, small_number), plain(one, one), large))
    FORBIDDEN_LENGTH(x, GAS(plain(x, one), plain(one, one), one))
    FORBIDDEN_LENGTH(x, GAS(plain(one, x), plain(one, one), one))
    FORBIDDEN_LENGTH(x, GAS(plain(one, one), plain(x, one), one))
    FORBIDDEN_LENGTH(x, GAS(plain(one, one), plain(one, x), one))
    FORBIDDEN_BELOW_0(x, GAS(plain(one, one), plain(one, one), x))
    FUNCTION(sph_gas_work)
    ALLOWED(sph_real, sph_gas_work(medium(small_number, one), zero, zero))
    FORBIDDEN_LENGTH(x, sph_gas_work(medium(x, one), one, one))
    FUNCTION(sph_gas_value)
    ALLOWED(sph_gas_change, sph_gas_value(plain(one, one), no_gas_sums))
    FORBIDDEN_LENGTH(x, sph_gas_value(plain(x, one), no_gas_sums))
    FORBIDDEN_LENGTH(x, sph_gas_value(plain(one, x), no_gas_sums))
    FUNCTION(sph_flow_of)
    ALLOWED(sph_flow, sph_flow_of(3, no_slope))
    FORBIDDEN(sph_flow_of(0, no_slope))
    FUNCTION(sph_velocity_gradient_pair)
    ALLOWED(sph_velocity_gradient, sph_velocity_gradient_pair(zero, nothing, nothing))
    FUNCTION(sph_viscosity_factor_balsara)
    ALLOWED(sph_real, sph_viscosity_factor_balsara(flowing(zero, zero), zero, small_number))
    FORBIDDEN_BELOW_0(x, sph_viscosity_factor_balsara(flowing(x, zero), one, one))
    FORBIDDEN_BELOW_0(x, sph_viscosity_factor_balsara(flowing(one, zero), x, one))
    FORBIDDEN_LENGTH(x, sph_viscosity_factor_balsara(flowing(one, zero), one, x))
    FUNCTION(sph_shock_pair)
    ALLOWED(sph_real, sph_shock_pair(zero, zero, zero))
    FUNCTION(sph_shock_value)
    ALLOWED(sph_real, sph_shock_value(zero, small_number))
    FORBIDDEN_LENGTH(x, sph_shock_value(one, x))
    FUNCTION(sph_shock_factor_cullen_dehnen)
    ALLOWED(sph_real, sph_shock_factor_cullen_dehnen(flowing(zero, zero), one))
    FORBIDDEN_BELOW_0(x, sph_shock_factor_cullen_dehnen(flowing(zero, x), zero))
    FUNCTION(sph_shock_factor_phantom)
    ALLOWED(sph_real, sph_shock_factor_phantom(flowing(zero, zero)))
    FORBIDDEN_BELOW_0(x, sph_shock_factor_phantom(flowing(x, zero)))
#define TARGET(which) \
    ALLOWED(sph_real, which(bounds(one, one), shocked(zero, small_number, zero, zero))) \
    FORBIDDEN(which(bounds(one, zero), shocked(one, one, one, one))) \
    FORBIDDEN_BELOW_0(x, which(bounds(zero, one), shocked(x, one, one, one))) \
    FORBIDDEN_LENGTH(x, which(bounds(zero, one), shocked(one, x, one, one))) \
    FORBIDDEN_BELOW_0(x, which(bounds(zero, one), shocked(one, one, x, one))) \
    FORBIDDEN_BELOW_0(x, which(bounds(zero, one), shocked(one, one, one, x)))
    FUNCTION(sph_viscosity_target_cullen_dehnen)
    TARGET(sph_viscosity_target_cullen_dehnen)
    FUNCTION(sph_viscosity_target_phantom)
    TARGET(sph_viscosity_target_phantom)
    FUNCTION(sph_viscosity_switch_after)
    ALLOWED(sph_real, sph_viscosity_switch_after(bounds(zero, one), shocked(one, small_number, zero, zero), zero, zero))
    FORBIDDEN_LENGTH(x, sph_viscosity_switch_after(bounds(zero, one), shocked(one, x, one, one), zero, one))
    FORBIDDEN_BELOW_0(x, sph_viscosity_switch_after(bounds(zero, one), shocked(one, one, one, x), zero, one))
    FORBIDDEN_BELOW_0(x, sph_viscosity_switch_after(bounds(zero, one), shocked(one, one, one, one), zero, x))

#define MHD(i, j, parts, r) sph_mhd_pair(2, mhd_terms(parts), i, j, pair_kernel(r), nothing)
    FUNCTION(sph_mhd_pair)
    ALLOWED(sph_mhd_sums, MHD(magnetised(one, one), magnetised(small_number, one), 2, zero))
    ALLOWED(sph_mhd_sums, MHD(magnetised(one, small_number), magnetised(one, one), 3, large))
    FORBIDDEN_LENGTH(x, MHD(magnetised(x, one), magnetised(one, one), 3, one))
    FORBIDDEN_LENGTH(x, MHD(magnetised(one, x), magnetised(one, one), 3, one))
    FORBIDDEN_LENGTH(x, MHD(magnetised(one, one), magnetised(x, one), 3, one))
    FORBIDDEN_LENGTH(x, MHD(magnetised(one, one), magnetised(one, x), 3, one))
    FORBIDDEN_BELOW_0(x, MHD(magnetised(one, one), magnetised(one, one), 3, x))
    FORBIDDEN(MHD(magnetised(one, one), magnetised(one, one), 1, one))
    FORBIDDEN(MHD(magnetised(one, one), magnetised(one, one), 4, one))
    FUNCTION(sph_mhd_value)
    ALLOWED(sph_mhd_change, sph_mhd_value(magnetised(one, one), no_sums, one, wave(zero, zero, small_number)))
    FORBIDDEN_LENGTH(x, sph_mhd_value(magnetised(x, one), no_sums, one, wave(one, one, one)))
    FORBIDDEN_LENGTH(x, sph_mhd_value(magnetised(one, x), no_sums, one, wave(one, one, one)))
    FORBIDDEN_LENGTH(x, sph_mhd_value(magnetised(one, one), no_sums, one, wave(zero, zero, x)))
    FORBIDDEN_BELOW_0(x, sph_mhd_value(magnetised(one, one), no_sums, one, wave(x, zero, one)))
}

/* ---- every scalar function of a header has an entry: SPH_FN at the start of a line, and no array */

static void complete(const char *path)
{
    static const char *const arrays[] = {"sph_points", "sph_cloud",  "sph_list",    "sph_grid",
                                         "sph_index ", "sph_query",  "SPH_GLOBAL",  "sph_scalar",
                                         "sph_vector", "_size(",     "_workspace("};
    enum { LINE = 1000 };
    FILE *const file = fopen(path, "r");
    char text[4 * LINE], name[LINE], *from, *end;
    int found = 0, e;
    size_t a;
    CHECK(file != 0);
    while (file && fgets(text, LINE, file)) {
        if (strncmp(text, "SPH_FN ", 7) != 0) continue;
        while (!strchr(text, ')') && strlen(text) < 3 * LINE && fgets(text + strlen(text), LINE, file)) {}
        end = strchr(text, '(');
        if (!end || !strchr(end, ')')) continue;
        *strchr(end, ')') = '\0';
        for (from = end; from > text && from[-1] != ' ' && from[-1] != '*'; from--) {}
        snprintf(name, sizeof name, "%.*s", (int)(end - from), from);
        if (strncmp(name, "sph_", 4) != 0) continue;
        for (a = 0; a < sizeof arrays / sizeof *arrays && !strstr(text, arrays[a]); a++) {}
        if (a < sizeof arrays / sizeof *arrays) continue;
        found++;
        for (e = 0; e < entries && strcmp(entry[e], name) != 0; e++) {}
        if (!check_count(e < entries))
            fprintf(stderr, "test_preconditions.c: failed: %s of %s has no entry\n", name, path);
    }
    if (file) fclose(file);
    CHECK(found > 0 || strcmp(path, "sph.h") == 0);
}

/* where no source is inside the support nothing is divided by the Shepard sum: a probe in the void has too
   few neighbours, with any gradient */
static void void_probe(void)
{
    const sph_real x[2] = {zero, SPH_R(5)}, volume[2] = {zero, one}, value = one;
    const sph_index start[2] = {0, 1}, index[1] = {1};
    sph_list list;
    sph_cloud probe;
    int gradient;
    list.start = start;
    list.index = index;
    probe = sph_cloud_of(sph_points_separate(2, x, 0, 0), list, sph_scalars_same(&one),
                         sph_scalars_array(volume));
    probe = sph_cloud_range(probe, 0, 1);
    for (gradient = 0; gradient <= (int)SPH_GRADIENT_SHEPARD_FULL; gradient++) {
        sph_elliptic_options options = {0};
        unsigned char status[2] = {99, 99};
        sph_real out[2];
        options.gradient = gradient;
        asserted = 0;
        CHECK(sph_elliptic_msph(k0, 1, probe, sph_scalars_same(&value), options, sph_scalars_same(&value),
                                sph_scalar_out_array(out, status)) == 1);
        CHECK_SAME(check_words("status with gradient %d", gradient), 0, status[0], SPH_TOO_FEW);
        CHECK(asserted == 0 && out[0] == zero);
    }
}

int main(void)
{
    volatile double nothing = 0.0;
    not_a_number = SPH_R(nothing / nothing);
    infinite = SPH_R(1.0 / nothing);
    small_number = SPH_R(BY_PRECISION(1e-40, 1e-12));
    large = SPH_R(BY_PRECISION(1e40, 1e12));
    some_moments = sph_moments_zero();
    short_h = SPH_R(BY_PRECISION(1e-50, 1e-5)); /* its inverse to the power of 5 is finite */
    kernels();
    vectors_and_systems();
    fluids();
    liquids();
    magnetised_gas();
    begin("the end");
    complete("sph_kernels.h");
    complete("sph_ops.h");
    complete("sph.h");
    void_probe();
    return check_report("test_preconditions");
}
