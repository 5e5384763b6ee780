/* SPDX-License-Identifier: MIT */
/*
 * sweeps.c - fuzz target: every list-tier function of sph_ops.h on views of any kind: strides, lists, ranges, kernels and dimensions that are none, null pointers, coincident particles, numbers that are none or
 * near the end of the range. Each must refuse and write nothing, or answer with finite numbers for its targets and for nobody else, and never read or write beyond an array. (What a list cannot tell is how many
 * entries index has; start never names more here.)
 */
#include "fuzz.h"

#include "../../sph_ops.h"

enum { MOST = 12, OUTPUTS = 12 };

typedef struct arguments {
    int k, dim, what;
    sph_cloud cloud;
    sph_scalars s[16]; /* fields of the particles */
    sph_real number[6];
    sph_real *out[OUTPUTS];
    unsigned char *status;
    sph_index *count;
    sph_index answer;
} arguments;

#define SWEEP (sph_kernel)a->k, a->dim, a->cloud
#define SWEEP_ONE (sph_kernel)a->k, a->cloud /* where the dimension is known */
#define LIST a->dim, a->cloud
#define OUT(i) a->out[i]

static sph_vectors vectors(const arguments *a, int from)
{
    sph_vectors v;
    v.x = a->s[from];
    v.y = a->s[from + 1];
    v.z = a->s[from + 2];
    return v;
}
static sph_vector_out vector_out(const arguments *a, int from) { return sph_vector_out_separate(OUT(from), OUT(from + 1), OUT(from + 2)); }
static sph_diagonal diagonal(const arguments *a, int from)
{
    sph_diagonal d;
    d.x = a->s[from];
    d.y = a->s[from + 1];
    d.z = a->s[from + 2];
    return d;
}
static sph_medium gas(const arguments *a)
{
    sph_medium g;
    g.m = a->s[0];
    g.rho = a->s[1];
    g.omega = a->s[2];
    return g;
}
static sph_derivatives_out derivative_out(const arguments *a)
{
    sph_derivatives_out o;
    o.gx = OUT(0), o.gy = OUT(1), o.gz = OUT(2);
    o.hxx = OUT(3), o.hxy = OUT(4), o.hyy = OUT(5), o.hxz = OUT(6), o.hyz = OUT(7), o.hzz = OUT(8);
    o.laplacian = OUT(9);
    o.conditioning = OUT(10);
    o.stride = 1;
    o.status = a->status;
    return o;
}
static sph_scalar_out scalar_out(const arguments *a) { return sph_scalar_out_array(OUT(0), a->status); }
static sph_derivatives_out gradient_out(const arguments *a)
{
    sph_derivatives_out o = derivative_out(a);
    o.conditioning = OUT(3);
    return o;
}
static sph_gradient_rows_out gradient_row_out(const arguments *a)
{
    sph_gradient_rows_out o = {0};
    o.x = OUT(0), o.y = OUT(1), o.z = OUT(2), o.conditioning = OUT(3);
    o.status = a->status;
    return o;
}
static sph_rows_out row_out(const arguments *a)
{
    sph_rows_out o = {0};
    o.row = OUT(0), o.diagonal = OUT(1), o.factor = OUT(2), o.conditioning = OUT(3);
    o.status = a->status;
    return o;
}
static sph_elliptic_options elliptic(const arguments *a)
{
    sph_elliptic_options o = {0};
    o.gradient = a->what % 5;
    o.mean = a->what / 5 % 4;
    o.gamma_star = a->what / 20 % 2;
    o.trace = a->what / 40 % 2;
    o.conditioning_min = a->number[0];
    o.potential = a->s[4];
    return o;
}
static sph_elliptic_options sourced(const arguments *a)
{
    sph_elliptic_options o = elliptic(a);
    o.source = a->s[12];
    return o;
}
static sph_boundary boundary(const arguments *a)
{
    sph_boundary b;
    b.normal = vectors(a, 5);
    b.alpha = a->s[8], b.beta = a->s[9];
    return b;
}
static sph_jet jet(const arguments *a)
{
    sph_jet d = sph_jet_laplacian(a->dim);
    d.gradient.x = a->number[0];
    d.hessian.xx = a->number[1];
    return d;
}
static sph_fluid fluid(const arguments *a)
{
    sph_fluid f;
    f.m = a->s[0], f.rho = a->s[1], f.p = a->s[3], f.c = a->s[4];
    f.v = vectors(a, 5);
    f.viscosity = a->what % 5;
    f.alpha = a->number[0], f.beta = a->number[1], f.eta = a->number[2];
    return f;
}
static sph_collision collision(const arguments *a)
{
    sph_collision c;
    c.distance = a->number[0], c.restitution = a->number[1];
    c.inverse_mass = a->s[1];
    return c;
}
static sph_cleaning cleaning(const arguments *a)
{
    sph_cleaning c;
    c.medium = gas(a);
    c.field = vectors(a, 8);
    c.psi = a->s[11], c.div_v = a->s[4];
    c.ch = a->number[0], c.sigma = a->number[1];
    return c;
}
static sph_cleaning_out cleaning_out(const arguments *a)
{
    sph_cleaning_out o = {0};
    o.rate_B = vector_out(a, 0);
    o.rate_psi = OUT(3), o.div_B = OUT(4);
    return o;
}
static sph_mhd mhd(const arguments *a)
{
    sph_mhd s;
    s.medium = gas(a);
    s.p = a->s[3], s.u = a->s[4], s.cs = a->s[1], s.alpha = a->s[0], s.alpha_B = a->s[1];
    s.v = vectors(a, 5);
    s.field = vectors(a, 8);
    s.psi = a->s[11];
    s.ch = a->number[0], s.sigma = a->number[1], s.beta = a->number[2], s.alpha_u = a->number[3], s.tensile = a->number[4];
    return s;
}
static sph_mhd_out mhd_out(const arguments *a)
{
    sph_mhd_out o = {0};
    o.acceleration = vector_out(a, 0);
    o.rate_B = vector_out(a, 3);
    o.rate_u = OUT(6), o.rate_psi = OUT(7), o.div_B = OUT(8), o.div_v = OUT(9), o.v_sig = OUT(10);
    return o;
}
static sph_gas plain_gas(const arguments *a)
{
    sph_gas s;
    s.medium = gas(a);
    s.p = a->s[3], s.u = a->s[4], s.cs = a->s[1], s.alpha = a->s[0];
    s.v = vectors(a, 5);
    s.beta = a->number[2], s.alpha_u = a->number[3];
    s.conductivity = a->what % 4;
    return s;
}
static sph_gas_out gas_out(const arguments *a)
{
    sph_gas_out o = {0};
    o.acceleration = vector_out(a, 0);
    o.rate_u = OUT(3), o.div_v = OUT(4), o.v_sig = OUT(5);
    return o;
}
static sph_velocity_gradient_out flow_out(const arguments *a)
{
    sph_velocity_gradient_out o = {0};
    o.div = OUT(0), o.curl = OUT(1), o.shear = OUT(2), o.square = OUT(3);
    return o;
}
static sph_shock_out shock_out(const arguments *a)
{
    sph_shock_out o = {0};
    o.ratio = OUT(0), o.v_sig = OUT(1);
    return o;
}
static sph_ohmic ohmic(const arguments *a)
{
    sph_ohmic s;
    s.medium = gas(a);
    s.eta = a->s[3];
    s.field = vectors(a, 5);
    return s;
}
static sph_ohmic_out ohmic_out(const arguments *a)
{
    sph_ohmic_out o = {0};
    o.rate_B = vector_out(a, 0);
    o.rate_u = OUT(3);
    return o;
}
static sph_elliptic_report report(const arguments *a)
{
    sph_elliptic_report o = {0};
    o.sign_least = OUT(0), o.sign_most = OUT(1), o.xi = OUT(2), o.continuity = OUT(3), o.n = OUT(4), o.n_bound = OUT(5), o.eigenvalue_least = OUT(6), o.eigenvalue_ratio = OUT(7);
    o.status = a->status;
    return o;
}
static sph_vec gravity(const arguments *a)
{
    sph_vec g;
    g.x = a->number[0], g.y = a->number[1], g.z = a->number[2];
    return g;
}
static sph_riemann_options riemann(const arguments *a)
{
    sph_riemann_options o;
    o.limiter = a->number[0];
    o.gravity = gravity(a);
    return o;
}
static sph_tension tension(const arguments *a)
{
    sph_tension t;
    t.rho = a->s[1];
    t.normal = vectors(a, 8);
    t.sigma = a->number[0], t.least = a->number[1];
    return t;
}
static sph_wall_terms wall_terms(const arguments *a)
{
    sph_wall_terms w;
    w.gamma = a->s[1], w.value = a->s[4];
    w.gradient = vectors(a, 5), w.slope = vectors(a, 8);
    return w;
}
static sph_matrices matrices(const arguments *a)
{
    sph_matrices m;
    m.x = vectors(a, 5), m.y = vectors(a, 8), m.z = vectors(a, 4);
    return m;
}
static sph_matrices mobility(const arguments *a) /* positive on the diagonal where numbers are tame */
{
    sph_matrices m;
    m.x.x = a->s[1], m.x.y = m.y.x = a->s[8], m.x.z = m.z.x = a->s[9];
    m.y.y = a->s[2], m.y.z = m.z.y = a->s[10], m.z.z = a->s[1];
    return m;
}
static sph_matrix_out matrix_out(const arguments *a)
{
    sph_matrix_out o;
    o.x = vector_out(a, 0), o.y = vector_out(a, 3), o.z = vector_out(a, 6);
    return o;
}
static sph_correction_out correction_out(const arguments *a)
{
    sph_correction_out o = {0};
    o.inverse = matrix_out(a), o.conditioning = OUT(9);
    o.status = a->status;
    return o;
}
static sph_rk rk(const arguments *a)
{
    sph_rk r;
    r.scale = a->s[4];
    r.slope = vectors(a, 5), r.scale_gradient = vectors(a, 8);
    r.slope_gradient = matrices(a);
    return r;
}
static sph_corrected_out corrected_out(const arguments *a)
{
    sph_corrected_out o = {0};
    o.acceleration = vector_out(a, 0), o.rate_u = OUT(3);
    return o;
}
static sph_solid solid(const arguments *a)
{
    sph_solid s;
    s.inverse = s.gradient = matrices(a);
    s.stress = mobility(a);
    s.density = a->s[1], s.modulus = a->s[2];
    s.hourglass = a->what & 1 ? a->number[0] : SPH_R(0);
    s.x = a->cloud.points;
    return s;
}
static sph_index right(const arguments *a) { return (sph_index)(a->what % MOST); } /* end of the domain */
static sph_shear_bulk shear_bulk(const arguments *a)
{
    sph_shear_bulk mu;
    mu.shear = a->s[2], mu.bulk = a->s[1];
    return mu;
}
static sph_wall wall(const arguments *a)
{
    sph_wall w;
    w.share = a->s[0], w.rho = a->s[1], w.p = a->s[3];
    w.v = vectors(a, 5), w.velocity = vectors(a, 8), w.normal = vectors(a, 5);
    w.gravity = gravity(a);
    return w;
}
static sph_wall_out wall_out(const arguments *a)
{
    sph_wall_out o = {0};
    o.p = OUT(3), o.v = vector_out(a, 0);
    o.status = a->status;
    return o;
}
static sph_wall_elements elements(const arguments *a) /* as many as particles, between any points */
{
    sph_wall_elements e = {0};
    e.n = a->cloud.points.n;
    e.a = vectors(a, 5), e.b = vectors(a, 8);
    e.c.x = a->s[9], e.c.y = a->s[5], e.c.z = a->s[3];
    if (a->what & 1) e.list = a->cloud.list;
    return e;
}
static sph_wall_gamma_out gamma_out(const arguments *a)
{
    sph_wall_gamma_out o = {0};
    o.gamma = OUT(3), o.gradient = vector_out(a, 0);
    o.status = a->status;
    return o;
}
/* the sources of the linear fits: as many as targets, in other places if what is odd */
static sph_sources sources(const arguments *a)
{
    sph_sources s;
    s.points = a->cloud.points;
    if (a->what & 1 && a->cloud.points.stride == a->s[3].stride) s.points.x = a->s[3].p;
    s.volume = a->s[0];
    return s;
}
static sph_interpolation_options interpolation(const arguments *a)
{
    sph_interpolation_options o = {0};
    o.conditioning_min = a->number[0];
    return o;
}
static sph_interpolation_out interpolation_out(const arguments *a)
{
    sph_interpolation_out o = {0};
    o.gx = OUT(0), o.gy = OUT(1), o.gz = OUT(2), o.value = OUT(3), o.conditioning = OUT(4);
    o.status = a->status;
    return o;
}
static sph_interpolation_rows_out interpolation_rows(const arguments *a)
{
    sph_interpolation_rows_out o = {0};
    o.x = OUT(0), o.y = OUT(1), o.z = OUT(2), o.value = OUT(3), o.conditioning = OUT(4);
    o.status = a->status;
    return o;
}

static sph_diffusion diffusion(const arguments *a)
{
    sph_diffusion d = {0};
    d.fluid = fluid(a);
    d.delta = a->number[0];
    d.tait.c = a->number[1], d.tait.rho0 = a->number[2];
    if (a->what & 1) d.share = a->s[4];
    d.gradient = vectors(a, 8);
    d.gravity.x = a->number[3];
    return d;
}
static sph_shift shifting(const arguments *a)
{
    sph_shift s = {0};
    s.strength = a->s[4];
    s.tensile = a->number[0], s.spacing = a->number[1], s.longest = a->number[2];
    if (a->what & 1) s.eigenvalue = a->s[3];
    s.normal = vectors(a, 8);
    return s;
}
static sph_surface_out surface_out(const arguments *a)
{
    sph_surface_out o = {0};
    o.normal = vector_out(a, 0);
    o.divergence = OUT(3), o.eigenvalue = OUT(4);
    o.status = a->status;
    return o;
}
static sph_transport_out transport_out(const arguments *a)
{
    sph_transport_out o = {0};
    o.background = vector_out(a, 0);
    o.stress = vector_out(a, 3);
    return o;
}

/* One X(call, outputs, pairs, flags) each: the first `pairs` outputs have a number for each pair, the others one for each target (ONE: one at all). VECTOR: of the first three as many as there are dimensions;
   VECTORS: of the first two times three, and all three of them where there is a third velocity, if VECTOR does not stand beside it; HESSIAN: of derivatives likewise; COUNTS: a->count; NO_COUNT: the answer is no number of targets that are not ok;
   SOME: targets may be passed over; MATRIX: the first nine are the rows of a matrix. */
enum { PLAIN = 0, VECTOR = 1, HESSIAN = 2, STATUS = 4, VECTORS = 8, COUNTS = 16, THREE = 32, NO_COUNT = 64, ONE = 128, SOME = 256, MATRIX = 512 };
/* clang-format off */
#define SWEEPS(X) \
    X(sph_shepard_sum(SWEEP, sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_interpolate_shepard(SWEEP, a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_density_summation(SWEEP, a->s[0], sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_density_number(SWEEP, a->s[0], sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_gradient_difference(SWEEP, a->s[3], vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_gradient_cspm(SWEEP, a->s[3], gradient_out(a)), 4, 0, VECTOR | STATUS) \
    X(sph_gradient_rows_cspm(SWEEP, gradient_row_out(a)), 4, 3, VECTOR | STATUS) \
    X(sph_laplacian_brookshaw(SWEEP, a->s[3], sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_laplacian_rows_brookshaw(SWEEP, (sph_rows_out){.row = OUT(0)}), 1, 1, PLAIN) \
    X(sph_derivatives_cspm(SWEEP, a->s[3], (sph_derivatives_options){.conditioning_min = a->number[0]}, derivative_out(a)), 11, 0, HESSIAN | STATUS) \
    X(sph_derivatives_icspm(SWEEP, a->s[3], (sph_derivatives_options){.conditioning_min = a->number[0], .fallback_wls = a->what & 1}, derivative_out(a)), 11, 0, HESSIAN | STATUS) \
    X(sph_derivatives_fatehi_manzari(SWEEP, a->s[3], (sph_derivatives_options){.conditioning_min = a->number[0], .fallback_wls = a->what & 1}, derivative_out(a)), 11, 0, HESSIAN | STATUS) \
    X(sph_derivatives_wls(SWEEP, a->s[3], (sph_derivatives_options){.conditioning_min = a->number[0]}, derivative_out(a)), 11, 0, HESSIAN | STATUS) \
    X(sph_derivatives_rows_cspm(SWEEP, jet(a), row_out(a)), 4, 1, STATUS) \
    X(sph_derivatives_rows_icspm(SWEEP, jet(a), row_out(a)), 4, 1, STATUS) \
    X(sph_derivatives_rows_fatehi_manzari(SWEEP, jet(a), row_out(a)), 4, 1, STATUS) \
    X(sph_derivatives_rows_wls(SWEEP, jet(a), row_out(a)), 4, 1, STATUS) \
    X(sph_second_derivative_bim(SWEEP_ONE, a->s[3], 0, right(a), scalar_out(a)), 1, 0, STATUS) \
    X(sph_second_derivative_rows_bim(SWEEP_ONE, 0, right(a), (sph_rows_out){.row = OUT(0), .status = a->status}), 1, 1, STATUS) \
    X(sph_elliptic_brookshaw(SWEEP, a->s[1], sourced(a), a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_elliptic_brookshaw_corrected(SWEEP, a->s[1], sourced(a), a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_elliptic_schwaiger(SWEEP, a->s[1], sourced(a), a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_elliptic_msph(SWEEP, a->s[1], sourced(a), a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_elliptic_basic_degiuli_ban(SWEEP, a->s[1], sourced(a), a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_elliptic_rows_brookshaw(SWEEP, a->s[1], elliptic(a), row_out(a)), 4, 1, STATUS) \
    X(sph_elliptic_rows_brookshaw_corrected(SWEEP, a->s[1], elliptic(a), row_out(a)), 4, 1, STATUS) \
    X(sph_elliptic_rows_schwaiger(SWEEP, a->s[1], elliptic(a), row_out(a)), 4, 1, STATUS) \
    X(sph_elliptic_rows_msph(SWEEP, a->s[1], elliptic(a), row_out(a)), 4, 1, STATUS) \
    X(sph_elliptic_rows_basic_degiuli_ban(SWEEP, a->s[1], elliptic(a), row_out(a)), 4, 1, STATUS) \
    X(sph_elliptic_rows_anisotropic(SWEEP, diagonal(a, 1), row_out(a)), 4, 1, STATUS) \
    X(sph_elliptic_rows_boundary(SWEEP, a->s[1], elliptic(a), boundary(a), row_out(a)), 4, 1, STATUS | SOME) \
    X(sph_elliptic_diagnose(SWEEP, elliptic(a), report(a)), 8, 0, STATUS) \
    X(sph_rows_apply(a->cloud, a->s[13].p, sph_scalars_array(a->s[14].p), a->s[3], sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_rows_monotone(a->cloud, a->s[13].p, sph_scalars_array(a->s[14].p), a->status), 0, 0, STATUS | NO_COUNT) \
    X(sph_rows_time_step(a->cloud, a->s[13].p, OUT(0)), 1, 0, ONE | NO_COUNT) \
    X(sph_fluid_rates_monaghan(SWEEP, fluid(a), (sph_fluid_out){.acceleration = vector_out(a, 0), .rate = OUT(3), .heating = OUT(4)}), 5, 0, VECTOR) \
    X(sph_fluid_rates_colagrossi(SWEEP, fluid(a), (sph_fluid_out){.acceleration = vector_out(a, 0), .rate = OUT(3), .heating = OUT(4)}), 5, 0, VECTOR) \
    X(sph_fluid_rates_hu_adams(SWEEP, fluid(a), (sph_fluid_out){.acceleration = vector_out(a, 0), .rate = OUT(3), .heating = OUT(4)}), 5, 0, VECTOR) \
    X(sph_fluid_rates_riemann(SWEEP, fluid(a), riemann(a), (sph_fluid_out){.acceleration = vector_out(a, 0), .rate = OUT(3), .heating = OUT(4)}), 5, 0, VECTOR) \
    X(sph_viscosity_mu_morris(SWEEP, fluid(a), a->s[2], vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_viscosity_mu_monaghan_cleary(SWEEP, fluid(a), a->s[2], vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_viscosity_mu_espanol_revenga(SWEEP, fluid(a), shear_bulk(a), vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_velocity_xsph(SWEEP, fluid(a), a->number[0], vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_wall_adami(SWEEP, wall(a), wall_out(a)), 4, 0, VECTOR | STATUS) \
    X(sph_density_diffusion_molteni(SWEEP, diffusion(a), scalar_out(a)), 1, 0, STATUS) \
    X(sph_density_diffusion_antuono(SWEEP, diffusion(a), scalar_out(a)), 1, 0, STATUS) \
    X(sph_density_diffusion_fourtakas(SWEEP, diffusion(a), scalar_out(a)), 1, 0, STATUS) \
    X(sph_density_diffusion_rows_molteni(SWEEP, diffusion(a), row_out(a)), 4, 1, STATUS) \
    X(sph_free_surface(SWEEP, surface_out(a)), 5, 0, VECTOR | STATUS) \
    X(sph_free_surface_cone(LIST, a->s[3], vectors(a, 5), a->status), 0, 0, STATUS | NO_COUNT) \
    X(sph_shift_displacement(SWEEP, shifting(a), vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_shift_rates(SWEEP, fluid(a), vectors(a, 8), (sph_fluid_out){.acceleration = vector_out(a, 0), .rate = OUT(3)}), 4, 0, VECTOR) \
    X(sph_transport_adami(SWEEP, fluid(a), vectors(a, 8), a->number[0], transport_out(a)), 6, 0, VECTOR | VECTORS) \
    X(sph_tension_css(SWEEP, tension(a), vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_tension_csf(SWEEP, tension(a), (sph_tension_out){.acceleration = vector_out(a, 0), .curvature = OUT(3), .status = a->status}), 4, 0, VECTOR | STATUS) \
    X(sph_wall_gradient(SWEEP, wall_terms(a), a->s[3], vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_wall_laplacian(SWEEP, wall_terms(a), a->s[3], sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_wall_gradient_rows(SWEEP, wall_terms(a), (sph_gradient_rows_out){.x = OUT(0), .y = OUT(1), .z = OUT(2), .status = a->status}, vector_out(a, 3)), 6, 3, VECTOR | VECTORS | STATUS) \
    X(sph_wall_laplacian_rows(SWEEP, wall_terms(a), row_out(a), sph_scalar_out_array(OUT(4), 0)), 5, 1, STATUS) \
    X(sph_pressure_factor_dfsph(SWEEP, fluid(a), a->what & 1 ? a->s[4] : sph_scalars_none(), scalar_out(a)), 1, 0, STATUS) \
    X(sph_wall_gamma(SWEEP, elements(a), gamma_out(a)), 4, 0, VECTOR | STATUS) \
    X(sph_wall_rows_adami(SWEEP, wall(a), row_out(a), sph_scalar_out_array(OUT(4), 0)), 5, 1, STATUS) \
    X(sph_interpolate_mls(SWEEP, sources(a), a->s[3], interpolation(a), interpolation_out(a)), 5, 0, VECTOR | STATUS) \
    X(sph_interpolate_liu(SWEEP, sources(a), a->s[3], interpolation(a), interpolation_out(a)), 5, 0, VECTOR | STATUS) \
    X(sph_interpolate_rows_mls(SWEEP, sources(a), interpolation(a), interpolation_rows(a)), 5, 4, VECTOR | STATUS) \
    X(sph_interpolate_rows_liu(SWEEP, sources(a), interpolation(a), interpolation_rows(a)), 5, 4, VECTOR | STATUS) \
    X(sph_collision_count(LIST, collision(a), vectors(a, 5), a->count), 0, 0, COUNTS) \
    X(sph_nearest_distance(LIST, a->cloud.points, scalar_out(a)), 1, 0, STATUS) \
    X(sph_hexatic_order(a->cloud, scalar_out(a)), 1, 0, STATUS) \
    X(sph_coincident_count(LIST, a->number[0]), 0, 0, NO_COUNT) \
    X(sph_divergence_difference(SWEEP, gas(a), vectors(a, 5), sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_divergence_symmetric(SWEEP, gas(a), vectors(a, 5), sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_gradient_symmetric(SWEEP, gas(a), a->s[3], vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_curl_difference(SWEEP, gas(a), vectors(a, 5), vector_out(a, 0)), 3, 0, THREE) \
    X(sph_cleaning_rates(SWEEP, cleaning(a), cleaning_out(a)), 5, 0, VECTOR) \
    X(sph_mhd_rates(SWEEP, mhd(a), mhd_out(a)), 11, 0, VECTORS) \
    X(sph_gas_rates(SWEEP, plain_gas(a), gas_out(a)), 6, 0, VECTOR) \
    X(sph_velocity_gradient_difference(SWEEP, gas(a), vectors(a, 5), flow_out(a)), 4, 0, PLAIN) \
    X(sph_velocity_gradient_cspm(SWEEP, vectors(a, 5), flow_out(a)), 4, 0, PLAIN) \
    X(sph_shock_indicator(SWEEP, plain_gas(a), a->s[11], shock_out(a)), 2, 0, PLAIN) \
    X(sph_resistivity_ohmic(SWEEP, ohmic(a), ohmic_out(a)), 4, 0, VECTORS) \
    X(sph_gradient_iad(SWEEP, a->s[3], gradient_out(a)), 4, 0, VECTOR | STATUS) \
    X(sph_gradient_rows_iad(SWEEP, gradient_row_out(a)), 4, 3, VECTOR | STATUS) \
    X(sph_gradient_correction_cspm(SWEEP, correction_out(a)), 10, 0, MATRIX | STATUS) \
    X(sph_gradient_correction_iad(SWEEP, correction_out(a)), 10, 0, MATRIX | STATUS) \
    X(sph_elliptic_tensor(SWEEP, mobility(a), a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_elliptic_rows_tensor(SWEEP, mobility(a), row_out(a)), 4, 1, STATUS) \
    X(sph_interpolate_rk(SWEEP, rk(a), a->s[3], scalar_out(a)), 1, 0, STATUS) \
    X(sph_interpolate_rows_rk(SWEEP, rk(a), row_out(a)), 4, 1, STATUS) \
    X(sph_gradient_rk(SWEEP, rk(a), a->s[3], vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_gradient_rows_rk(SWEEP, rk(a), gradient_row_out(a)), 4, 3, VECTOR | STATUS) \
    X(sph_gas_rates_crk(SWEEP, fluid(a), rk(a), corrected_out(a)), 4, 0, VECTOR) \
    X(sph_gas_rates_iad(SWEEP, fluid(a), matrices(a), corrected_out(a)), 4, 0, VECTOR) \
    X(sph_deformation_gradient(SWEEP, a->cloud.points, matrices(a), matrix_out(a)), 9, 0, MATRIX) \
    X(sph_solid_acceleration(SWEEP, solid(a), vector_out(a, 0)), 3, 0, VECTOR) \
    X(sph_gravity_direct(SWEEP_ONE, a->s[0], a->number[0], vector_out(a, 0), sph_scalar_out_array(OUT(3), 0)), 4, 0, THREE) \
    X(sph_gravity_zeta(SWEEP_ONE, a->s[0], a->s[1], sph_scalar_out_array(OUT(0), 0)), 1, 0, PLAIN) \
    X(sph_gravity_correction(SWEEP_ONE, gas(a), a->s[4], a->number[0], vector_out(a, 0)), 3, 0, THREE)
/* clang-format on */

static sph_index call(int which, const arguments *a)
{
    int number = 0;
#define CALL(call, outputs, pairs, flags) \
    if (which == number++) return call;
    SWEEPS(CALL)
#undef CALL
    return 0;
}
typedef struct description {
    const char *name;
    int outputs, pairs, flags;
} description;
#define DESCRIBE(call, outputs, pairs, flags) {#call, outputs, pairs, flags},
static const description descriptions[] = {SWEEPS(DESCRIBE)};
enum { COUNT = sizeof descriptions / sizeof *descriptions };

/* ---- what was written ---- */

static const unsigned char MARK = 0x5c;
static int is_marked(const void *p, size_t size)
{
    const unsigned char *const byte = (const unsigned char *)p;
    size_t i;
    for (i = 0; i < size; i++)
        if (byte[i] != MARK) return 0;
    return 1;
}

static const description *now;
static void require(int holds, int line, const char *text, const arguments *a)
{
    if (holds) return;
    fprintf(stderr, "%s, kernel %d, %dD, targets %ld ... %ld of %ld answered %ld\n", now->name, a->k, a->dim,
            (long)a->cloud.first, (long)a->cloud.last, (long)a->cloud.points.n, (long)a->answer);
    fuzz_require(0, __FILE__, line, text);
}
#define REQUIRE(condition) require((condition) ? 1 : 0, __LINE__, #condition, a)

/* must output o have been written at all? Those of directions that there are not, or of B and v of fewer components, need not. */
static int is_written(const arguments *a, int o)
{
    const int flags = now->flags, parts = a->s[7].p && !(flags & VECTOR) ? 3 : a->dim;
    if (!a->out[o]) return 0;
    if (flags & MATRIX) return o > 8 || (o % 3 < a->dim && o / 3 < a->dim);
    if (flags & VECTORS) return o > 5 || o % 3 < parts;
    if (flags & VECTOR) return o > 2 || o < a->dim;
    if (flags & HESSIAN) return o < 3 ? o < a->dim : o > 8 || o - 3 < a->dim * (a->dim + 1) / 2;
    return 1;
}

static void check_answer(const arguments *a, size_t room)
{
    const sph_index answer = a->answer;
    sph_index i;
    int o;
    REQUIRE(answer >= SPH_ERROR_PAIRS);
    if (!(now->flags & NO_COUNT))
        REQUIRE(answer <= (a->cloud.last > a->cloud.first ? a->cloud.last - a->cloud.first : 0));
    for (o = 0; o < OUTPUTS; o++) {
        const int pairs = o < now->pairs, used = answer >= 0 && o < now->outputs && is_written(a, o);
        const int none = answer < 0 || a->cloud.first >= a->cloud.last; /* there may be no lists then */
        sph_index low = none       ? 0
                        : pairs    ? a->cloud.list.start[a->cloud.first]
                                   : a->cloud.first,
                  high = none       ? 0
                         : pairs    ? a->cloud.list.start[a->cloud.last]
                                    : a->cloud.last;
        if (now->flags & ONE) low = 0, high = 1;
        if (!a->out[o]) continue;
        for (i = 0; i < (sph_index)room; i++) {
            if (used && i >= low && i < high) REQUIRE(is_marked(&a->out[o][i], sizeof(sph_real)) ? now->flags & SOME : isfinite(a->out[o][i]));
            else if (answer < 0 || o >= now->outputs || used) REQUIRE(is_marked(&a->out[o][i], sizeof(sph_real)));
        }
    }
    for (i = 0; a->status && i < a->cloud.points.n; i++) {
        const int written = answer >= 0 && (now->flags & STATUS) && i >= a->cloud.first && i < a->cloud.last;
        REQUIRE(a->status[i] == MARK ? !written || (now->flags & SOME) : written && a->status[i] <= SPH_LIST_TOO_SHORT);
    }
}

/* ---- functions that answer in ways of their own ---- */

static int all_finite(const sph_real *p, size_t count)
{
    size_t i;
    for (i = 0; i < count; i++)
        if (!isfinite(p[i])) return 0;
    return 1;
}
static void own_density_adaptive(const arguments *a)
{
    const size_t n = a->cloud.points.n > 0 ? (size_t)a->cloud.points.n : 0;
    sph_density_options options;
    sph_density_out out = {0};
    size_t i;
    sph_index answer;
    for (i = 0; i < n && a->out[0]; i++)
        a->out[0][i] = a->cloud.h.p ? a->cloud.h.p[a->cloud.h.stride ? i * a->cloud.h.stride : 0] : SPH_R(1);
    options.list_radius = a->cloud.h, options.eta = SPH_R(1.2), options.tolerance = SPH_R(1e-3);
    out.h = OUT(0), out.rho = OUT(1), out.omega = OUT(2);
    out.status = a->status;
    answer = sph_density_adaptive(SWEEP, a->s[0], options, out);
    for (i = 0; answer >= 0 && i < n; i++) {
        if ((sph_index)i < a->cloud.first || (sph_index)i >= a->cloud.last) continue;
        REQUIRE(isfinite(a->out[0][i]) && a->out[0][i] > SPH_R(0));
        REQUIRE((!a->out[1] || isfinite(a->out[1][i])) && (!a->out[2] || isfinite(a->out[2][i])));
    }
}
static void own_collide(const arguments *a)
{
    const size_t n = a->cloud.points.n > 0 ? (size_t)a->cloud.points.n : 0;
    sph_collision_report r;
    sph_index answer;
    size_t i;
    int c, finite = 1;
    for (c = 0; c < 3; c++)
        for (i = 0; i < n && a->out[c]; i++) a->out[c][i] = SPH_R((double)(i % 3) - (double)c);
    answer = sph_collision_sequential(LIST, collision(a), vector_out(a, 0), &r);
    for (c = 0; c < a->dim && c < 3; c++) finite = finite && (!a->out[c] || all_finite(a->out[c], n));
    if (answer >= 0) REQUIRE((finite && isfinite(r.energy) && r.collisions >= 0) || answer > 0);
}
static void own_weighted(const arguments *a)
{
    const size_t n = a->cloud.points.n > 0 ? (size_t)a->cloud.points.n : 0;
    size_t i;
    int c;
    for (i = 0; i < n && a->count; i++) a->count[i] = (sph_index)((int)(i * 7 + (size_t)a->what) % 5 - (a->what > 200));
    if (sph_collision_change_weighted(LIST, collision(a), vectors(a, 5), a->count, vector_out(a, 0)) < 0)
        return;
    for (c = 0; c < a->dim; c++)
        REQUIRE(all_finite(a->out[c] + a->cloud.first, (size_t)(a->cloud.last - a->cloud.first)));
}
static void own_separate(const arguments *a)
{
    int c;
    if (sph_coincident_separate(LIST, a->number[0], a->number[1], vector_out(a, 0)) < 0) return;
    for (c = 0; c < a->dim; c++)
        REQUIRE(all_finite(a->out[c] + a->cloud.first, (size_t)(a->cloud.last - a->cloud.first)));
}
static void own_radial(const arguments *a)
{
    const int bins = a->what % 9;
    sph_real *const g = (sph_real *)fuzz_memory((size_t)bins, sizeof *g);
    if (sph_radial_distribution(LIST, a->number[0], a->number[1], bins, g) >= 0)
        REQUIRE(all_finite(g, (size_t)bins));
    free(g);
}
static void own_sums(const arguments *a)
{
    sph_conserved c;
    if (sph_conserved_sums(LIST, a->s[0], vectors(a, 5), &c) < 0) return;
    REQUIRE(isfinite(c.mass) && isfinite(c.kinetic_energy) && isfinite(c.momentum.x) && isfinite(c.momentum.y) && isfinite(c.momentum.z) && isfinite(c.angular_momentum.x) &&
            isfinite(c.angular_momentum.y) && isfinite(c.angular_momentum.z));
}
static void own_growth(const arguments *a)
{
    sph_real re, im;
    if (sph_rows_growth(a->dim, sph_cloud_range(a->cloud, a->cloud.first, a->cloud.first + 1), a->s[13].p,
                        a->number[3], gravity(a), &re, &im) == 0)
        REQUIRE(isfinite(re) && isfinite(im));
}
static void own_eliminate(const arguments *a) /* rows are read and written */
{
    const sph_list list = a->cloud.list;
    const size_t pairs = a->cloud.points.n > 0 && list.start && list.start[a->cloud.points.n] > 0 ? (size_t)list.start[a->cloud.points.n] : 0;
    sph_rows_out o = {0};
    size_t p;
    sph_index i;
    for (p = 0; p < pairs && a->out[0] && a->s[13].p; p++) a->out[0][p] = a->s[13].p[p];
    o.row = OUT(0), o.diagonal = OUT(1);
    if (sph_wall_rows_eliminate(LIST, wall(a), o, sph_scalar_out_array(OUT(2), a->status)) < 0) return;
    for (i = a->cloud.first; i < a->cloud.last; i++) {
        REQUIRE(isfinite(a->out[2][i]) && (!a->out[1] || isfinite(a->out[1][i])));
        REQUIRE(all_finite(a->out[0] + list.start[i], (size_t)(list.start[i + 1] - list.start[i])));
    }
}
static void own_rk_correction(const arguments *a)
{
    sph_real room[16 * MOST] = {SPH_R(0)};
    sph_rk_out o = {0};
    o.scale = room;
    o.slope = sph_vector_out_separate(room + MOST, room + 2 * MOST, room + 3 * MOST);
    o.scale_gradient = sph_vector_out_separate(room + 4 * MOST, room + 5 * MOST, room + 6 * MOST);
    o.slope_gradient = sph_matrix_out_packed(a->dim, room + 7 * MOST);
    o.status = a->status;
    sph_rk_correction(SWEEP, o);
    REQUIRE(all_finite(room, sizeof room / sizeof *room));
}
typedef struct own {
    void (*run)(const arguments *);
    description d;
} own;
static const own owns[] = {{own_density_adaptive, {"sph_density_adaptive", 0, 0, 0}}, {own_collide, {"sph_collision_sequential", 0, 0, 0}}, {own_weighted, {"sph_collision_change_weighted", 0, 0, 0}},
                           {own_separate, {"sph_coincident_separate", 0, 0, 0}},      {own_radial, {"sph_radial_distribution", 0, 0, 0}}, {own_sums, {"sph_conserved_sums", 0, 0, 0}},
                           {own_growth, {"sph_rows_growth", 0, 0, 0}},               {own_eliminate, {"sph_wall_rows_eliminate", 0, 0, 0}},
                           {own_rk_correction, {"sph_rk_correction", 0, 0, 0}}};
enum { OWNS = sizeof owns / sizeof *owns };

/* ---- arguments ---- */

static void *kept[64];
static int kept_count;
static void *keep(void *p)
{
    if (kept_count < 64) kept[kept_count++] = p;
    return p;
}

/* numbers of just the size that a view of this stride needs; kind 0: any, 1: tame, 2: tame and positive */
static sph_scalars scalars(fuzz_input *in, sph_index n, size_t stride, int kind)
{
    const size_t count = n > 0 ? ((size_t)n - 1) * stride + 1 : stride ? 0 : 1;
    sph_real *const p = (sph_real *)keep(fuzz_memory(count, sizeof *p));
    size_t i;
    for (i = 0; i < count; i++) {
        double v = kind ? fuzz_tame(in) : fuzz_number(in);
        if (kind == 2) v = 0.05 + fabs(v);
        p[i] = SPH_R(v);
    }
    return sph_scalars_strided(p, stride);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    const int which = fuzz_below(&in, COUNT + OWNS), how = (int)fuzz_byte(&in), hostile = (how & 3) == 0, bad_numbers = (how & 3) == 1, periodic = how >> 2 & 1, nulls = hostile && (how >> 3 & 1);
    const sph_index n = (sph_index)(hostile ? fuzz_below(&in, MOST + 1) : 1 + fuzz_below(&in, MOST));
    const int kind = hostile || bad_numbers ? 0 : 1, positive = kind ? 2 : 0;
    arguments arguments_, *const a = &arguments_;
    sph_index *start, *index, i;
    sph_scalars axis[3];
    size_t stride, room;
    int f, pairs;
    now = which < OWNS ? &owns[which].d : &descriptions[which - OWNS]; /* so that entries of SWEEPS that are new do not move the first */
    memset(a, 0, sizeof *a);
    a->what = (int)fuzz_byte(&in);
    a->k = hostile ? (int)(int8_t)fuzz_byte(&in) % (SPH_KERNEL_COUNT + 2) : fuzz_below(&in, SPH_KERNEL_COUNT);
    a->dim = hostile ? fuzz_below(&in, 5) : 1 + fuzz_below(&in, 3);
    a->cloud.first = (sph_index)(hostile ? fuzz_below(&in, MOST + 3) - 1 : 0);
    a->cloud.last = (sph_index)(hostile ? fuzz_below(&in, MOST + 3) - 1 : n);
    for (f = 0; f < 6; f++) a->number[f] = SPH_R(kind ? fabs(fuzz_tame(&in)) : fuzz_number(&in));

    stride = (size_t)(hostile ? fuzz_below(&in, 4) : 1 + fuzz_below(&in, 2));
    for (f = 0; f < 3; f++) axis[f] = scalars(&in, n, stride, kind);
    a->cloud.points = sph_points_strided(hostile && (how >> 4 & 3) == 3 ? (sph_index)-1 : n, axis[0].p,
                                         axis[1].p, axis[2].p, stride);
    if (periodic)
        a->cloud.points =
            sph_points_periodic(a->cloud.points, SPH_R(kind ? 7.0 : fuzz_number(&in)),
                                SPH_R(kind ? 0.0 : fuzz_number(&in)), SPH_R(kind ? 9.0 : fuzz_number(&in)));
    a->cloud.h = scalars(&in, n, (size_t)fuzz_below(&in, 3), positive);
    for (f = 0; f < 12; f++) a->s[f] = scalars(&in, n, (size_t)fuzz_below(&in, 3), f < 3 ? positive : kind);
    a->s[12] = fuzz_below(&in, 2) ? a->s[3] : sph_scalars_array(NULL); /* the source of an elliptic operator need not be there */

    start = (sph_index *)keep(fuzz_memory((size_t)n + 1, sizeof *start));
    for (i = 0, pairs = 0; i <= n; i++) {
        start[i] = (sph_index)pairs;
        if (i < n) pairs += hostile ? fuzz_below(&in, 6) : fuzz_below(&in, 2 * n);
    }
    index = (sph_index *)keep(fuzz_memory((size_t)pairs, sizeof *index));
    for (i = 0; i < n; i++) {
        sph_index p;
        for (p = start[i]; p < start[i + 1]; p++) {
            index[p] = (sph_index)(hostile ? fuzz_below(&in, MOST + 2) - 1 : fuzz_below(&in, n));
            if (!hostile && index[p] == i) index[p] = (sph_index)(n > 1 ? (i + 1) % n : 0);
        }
    }
    if (!hostile && n == 1) memset(start, 0, 2 * sizeof *start);
    if (hostile && (how >> 6 & 1)) start[fuzz_below(&in, n + 1)] = (sph_index)(fuzz_below(&in, pairs + 2) - 1); /* descends, begins before the first, ends early */
    a->cloud.list.start = start;
    a->cloud.list.index = index;
    a->s[13] = scalars(&in, (sph_index)pairs, 1, kind);
    a->s[14] = scalars(&in, n, 1, kind);

    room = (size_t)(pairs > n ? pairs : n);
    for (f = 0; f < OUTPUTS; f++) {
        a->out[f] = (sph_real *)keep(fuzz_memory(room, sizeof(sph_real)));
        memset(a->out[f], MARK, room * sizeof(sph_real));
    }
    a->status = (unsigned char *)keep(fuzz_memory((size_t)n, 1));
    memset(a->status, MARK, (size_t)n);
    a->count = (sph_index *)keep(fuzz_memory((size_t)n, sizeof *a->count));
    if (nulls) {
        const int none = (int)fuzz_byte(&in);
        if (none < 16) a->s[none].p = NULL;
        else if (none < 16 + OUTPUTS) a->out[none - 16] = NULL;
        else if (none == 30) a->cloud.points.x = NULL;
        else if (none == 31) a->cloud.points.y = NULL;
        else if (none == 32) a->cloud.points.z = NULL;
        else if (none == 33) a->cloud.list.start = NULL;
        else if (none == 34) a->cloud.list.index = NULL;
        else if (none == 35) a->cloud.h.p = NULL;
        else if (none == 36) a->status = NULL;
        else if (none == 37) a->count = NULL;
    }
    a->cloud.volume = a->s[0];
    if (which < OWNS) owns[which].run(a);
    else {
        a->answer = call(which - OWNS, a);
        check_answer(a, room);
    }
    while (kept_count > 0) free(kept[--kept_count]);
    return 0;
}
