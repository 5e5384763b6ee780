/* SPDX-License-Identifier: MIT */
/*
 * test_invariance.c - what every operator owes to space: the result does not depend on where the origin is, how the axes are turned or mirrored, the unit of length, the names of the
 * particles, and how the host divides the targets. Each output is declared with what it is (scalar, vector, ...) and with its power of length.
 *
 *     test_invariance            checks
 *     test_invariance -values    prints all outputs: tests/precision.sh compares those of float with those of double
 */
#include "one_copy.h"

#include "../sph.h"

#include "check.h"
#include "clouds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EPSILON ((double)SPH_EPSILON)

/* ---- a cloud with a field of every kind ---- */

enum { M, RHO, OMEGA, V, P, U, CS, ALPHA, PSI, F, MU, ZETA, SHARE, H, REACH, VX, VY, VZ, BX, BY, BZ, FIELDS };
enum { OUTPUTS = 12, ELEMENTS = 12 };
typedef struct world {
    cloud c;
    sph_real *a[FIELDS], *out[OUTPUTS];
    unsigned char *status;
    sph_real sigma; /* damping of the cleaning */
    int marked;     /* 1: the cloud is checked once, before all calls */
    sph_real corner[3][3][ELEMENTS]; /* of elements of a wall: a, b, c; axis */
    sph_vec gravity;
} world;

static world world_new(int dim, sph_index n)
{
    world w;
    int k;
    w.c = cloud_new(dim, n);
    for (k = 0; k < FIELDS; k++) w.a[k] = (sph_real *)cloud_memory((size_t)n, sizeof *w.a[k]);
    for (k = 0; k < OUTPUTS; k++) w.out[k] = (sph_real *)cloud_memory((size_t)n, sizeof *w.out[k]);
    w.status = (unsigned char *)cloud_memory((size_t)n, 1);
    w.sigma = SPH_R(1);
    w.marked = 0;
    memset(w.corner, 0, sizeof w.corner);
    w.gravity.x = SPH_R(0.3);
    w.gravity.y = SPH_R(dim > 1 ? -1 : 0);
    w.gravity.z = SPH_R(dim > 2 ? 0.4 : 0);
    return w;
}
static void world_free(world *w)
{
    int k;
    cloud_free(&w->c);
    for (k = 0; k < FIELDS; k++) free(w->a[k]);
    for (k = 0; k < OUTPUTS; k++) free(w->out[k]);
    free(w->status);
}
static double square(double x) { return x * x; }
static sph_real distance(const cloud *c, sph_index i, sph_index j)
{
    double a[3], b[3];
    cloud_position(c, i, a);
    cloud_position(c, j, b);
    return SPH_R(sqrt(square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2])));
}
/* a jittered lattice with an edge; numbers that float and double share; lists of all pairs within the larger reach, with a margin so that no pair is on the edge of a list */
static world first_world(int dim)
{
    static const int side[] = {0, 40, 9, 6};
    cloud lattice = cloud_lattice(dim, side[dim], 1.3, 0.2, (uint64_t)dim + 40);
    world w = world_new(dim, lattice.n);
    sph_index i, j, *index;
    pcg32 g;
    int k;
    pcg32_seed(&g, 5, (uint64_t)dim);
    for (i = 0; i < w.c.n; i++) {
        w.c.x[i] = SPH_R((float)lattice.x[i]);
        w.c.y[i] = SPH_R((float)lattice.y[i]);
        w.c.z[i] = SPH_R((float)lattice.z[i]);
        for (k = 0; k < FIELDS; k++) w.a[k][i] = SPH_R((float)(1.0 + 0.4 * cloud_symmetric(&g)));
        for (k = VX; k < FIELDS; k++) w.a[k][i] = SPH_R((k - VX) % 3 < dim ? (float)cloud_symmetric(&g) : 0.0f);
        w.a[PSI][i] = SPH_R((float)cloud_symmetric(&g));
        w.a[V][i] = SPH_R((float)(pow(lattice.dx, dim) * (1.0 + 0.2 * cloud_symmetric(&g))));
        w.a[H][i] = SPH_R((float)((double)lattice.h * (1.0 + 0.1 * cloud_symmetric(&g))));
        w.a[REACH][i] = SPH_R((float)(3.0 * (double)lattice.h));
        w.a[M][i] = w.a[V][i];
        w.a[SHARE][i] = SPH_R(i % 3 != 0);
    }
    w.c.dx = lattice.dx;
    w.c.h = lattice.h;
    index = w.c.index = (sph_index *)cloud_memory((size_t)w.c.n * (size_t)w.c.n, sizeof *index);
    for (i = 0; i < w.c.n; i++) {
        for (j = 0; j < w.c.n; j++)
            if (j != i && distance(&w.c, i, j) < SPH_R(3.3) * lattice.h) *index++ = j;
        w.c.start[i + 1] = (sph_index)(index - w.c.index);
    }
    for (i = 0; i < ELEMENTS; i++) { /* anywhere: of elements that close nothing gamma means little, but moves with them */
        int corner, axis;
        for (corner = 0; corner < 3; corner++)
            for (axis = 0; axis < dim; axis++) w.corner[corner][axis][i] = SPH_R((float)(0.5 + 0.5 * cloud_symmetric(&g)));
    }
    cloud_free(&lattice);
    return w;
}

/* ---- operators: each leaves its outputs for the targets first ... last - 1 in w->out ---- */

static const sph_kernel KERNEL = SPH_WENDLAND_C4;
static sph_scalars at(const world *w, int field) { return sph_scalars_array(w->a[field]); }
static sph_vectors vectors(const world *w, int field) { return sph_vectors_separate(w->a[field], w->a[field + 1], w->c.dim > 2 ? w->a[field + 2] : 0); }
static sph_vector_out into(const world *w, int k) { return sph_vector_out_separate(w->out[k], w->out[k + 1], w->out[k + 2]); }
static sph_medium gas(const world *w)
{
    sph_medium g;
    g.m = at(w, M);
    g.rho = at(w, RHO);
    g.omega = at(w, OMEGA);
    return g;
}
static sph_fluid fluid(const world *w)
{
    sph_fluid f;
    f.m = at(w, M);
    f.rho = at(w, RHO);
    f.p = at(w, P);
    f.c = at(w, CS);
    f.v = vectors(w, VX);
    f.viscosity = SPH_VISCOSITY_MONAGHAN;
    f.alpha = SPH_R(0.7);
    f.beta = SPH_R(1.1);
    f.eta = SPH_R(0.1);
    return f;
}
static sph_cleaning cleaned(const world *w)
{
    sph_cleaning c;
    c.medium = gas(w);
    c.field = vectors(w, BX);
    c.psi = at(w, PSI);
    c.div_v = sph_scalars_none();
    c.ch = SPH_R(1.3);
    c.sigma = w->sigma;
    return c;
}
static sph_cleaning_out cleaning_into(const world *w)
{
    sph_cleaning_out o = {0};
    o.rate_B = into(w, 0);
    o.rate_psi = w->out[3];
    o.div_B = w->out[4];
    return o;
}
static sph_cloud all(const world *w)
{
    const sph_cloud c = sph_cloud_of(cloud_points(&w->c), cloud_list(&w->c), at(w, H), at(w, V));
    return w->marked ? sph_cloud_checked(w->c.dim, c) : c;
}
typedef sph_index operator_fn(world *w, sph_index first, sph_index last);
/* the arguments that most begin with */
#define FRAME sph_cloud_range(all(w), first, last)
#define SWEEP KERNEL, w->c.dim, FRAME
#define OUT(k) w->out[k]
#define SCALAR_OUT sph_scalar_out_array(OUT(0), w->status)
#define OPERATOR(name, call) \
    static sph_index name(world *w, sph_index first, sph_index last) { return call; }

OPERATOR(shepard_sum, sph_shepard_sum(SWEEP, sph_scalar_out_array(OUT(0), 0)))
OPERATOR(interpolate, sph_interpolate_shepard(SWEEP, at(w, F), SCALAR_OUT))
OPERATOR(density_summation, sph_density_summation(SWEEP, at(w, M), sph_scalar_out_array(OUT(0), 0)))
OPERATOR(density_number, sph_density_number(SWEEP, at(w, M), sph_scalar_out_array(OUT(0), 0)))
OPERATOR(gradient_difference, sph_gradient_difference(SWEEP, at(w, F), into(w, 0)))
OPERATOR(laplacian_brookshaw, sph_laplacian_brookshaw(SWEEP, at(w, F), sph_scalar_out_array(OUT(0), 0)))
OPERATOR(elliptic_brookshaw,
         sph_elliptic_brookshaw(SWEEP, at(w, MU), (sph_elliptic_options){0}, at(w, F), SCALAR_OUT))
OPERATOR(elliptic_corrected,
         sph_elliptic_brookshaw_corrected(SWEEP, at(w, MU), (sph_elliptic_options){0}, at(w, F), SCALAR_OUT))
OPERATOR(elliptic_schwaiger,
         sph_elliptic_schwaiger(SWEEP, at(w, MU), (sph_elliptic_options){0}, at(w, F), SCALAR_OUT))
OPERATOR(elliptic_msph, sph_elliptic_msph(SWEEP, at(w, MU), (sph_elliptic_options){0}, at(w, F), SCALAR_OUT))
OPERATOR(viscous_morris, sph_viscosity_mu_morris(SWEEP, fluid(w), at(w, MU), into(w, 0)))
OPERATOR(viscous_cleary, sph_viscosity_mu_monaghan_cleary(SWEEP, fluid(w), at(w, MU), into(w, 0)))
static sph_index elliptic_basic(world *w, sph_index first, sph_index last)
{
    const sph_index fell = sph_elliptic_basic_degiuli_ban(SWEEP, at(w, MU), (sph_elliptic_options){0}, at(w, F), SCALAR_OUT);
    return fell < 0 ? fell : 0; /* at the boundary the scale falls back: that is an answer, too */
}
static sph_index viscous_espanol(world *w, sph_index first, sph_index last)
{
    const sph_shear_bulk mu = {at(w, MU), at(w, U)};
    return sph_viscosity_mu_espanol_revenga(SWEEP, fluid(w), mu, into(w, 0));
}
OPERATOR(xsph, sph_velocity_xsph(SWEEP, fluid(w), SPH_R(0.5), into(w, 0)))
static sph_diffusion diffusion(const world *w)
{
    sph_diffusion d = {0};
    d.fluid = fluid(w);
    d.tait.c = SPH_R(1.3);
    d.share = at(w, PSI);
    return d;
}
OPERATOR(diffusion_molteni, sph_density_diffusion_molteni(SWEEP, diffusion(w), SCALAR_OUT))
OPERATOR(free_surface, sph_free_surface(SWEEP, (sph_surface_out){.divergence = OUT(3), .eigenvalue = OUT(4), .normal = into(w, 0)}))
static sph_index shifted(world *w, sph_index first, sph_index last)
{
    const sph_real strength = SPH_R(1);
    sph_shift s = {0};
    s.strength = sph_scalars_same(&strength);
    s.tensile = SPH_R(0.2);
    s.spacing = SPH_R(0.8);
    s.longest = SPH_R(-1);
    return sph_shift_displacement(SWEEP, s, into(w, 0));
}
OPERATOR(shift_rates, sph_shift_rates(SWEEP, fluid(w), vectors(w, BX), (sph_fluid_out){.acceleration = into(w, 0), .rate = OUT(3)}))
OPERATOR(transport, sph_transport_adami(SWEEP, fluid(w), vectors(w, BX), SPH_R(1.7), (sph_transport_out){into(w, 0), into(w, 3), 0}))
OPERATOR(divergence_difference, sph_divergence_difference(SWEEP, gas(w), vectors(w, BX), sph_scalar_out_array(OUT(0), 0)))
OPERATOR(divergence_symmetric, sph_divergence_symmetric(SWEEP, gas(w), vectors(w, BX), sph_scalar_out_array(OUT(0), 0)))
OPERATOR(gradient_symmetric, sph_gradient_symmetric(SWEEP, gas(w), at(w, F), into(w, 0)))
OPERATOR(curl_difference, sph_curl_difference(SWEEP, gas(w), vectors(w, BX), into(w, 0)))
OPERATOR(cleaning, sph_cleaning_rates(SWEEP, cleaned(w), cleaning_into(w)))
OPERATOR(gravity_direct, sph_gravity_direct(KERNEL, FRAME, at(w, M), SPH_R(1), into(w, 0), sph_scalar_out_array(OUT(3), 0)))
OPERATOR(gravity_zeta, sph_gravity_zeta(KERNEL, FRAME, at(w, M), at(w, RHO), sph_scalar_out_array(OUT(0), 0)))
OPERATOR(gravity_correction, sph_gravity_correction(KERNEL, FRAME, gas(w), at(w, ZETA), SPH_R(1), into(w, 0)))
OPERATOR(nearest_distance, sph_nearest_distance(w->c.dim, FRAME, cloud_points(&w->c), SCALAR_OUT))
OPERATOR(hexatic_order, sph_hexatic_order(FRAME, SCALAR_OUT))

static sph_index density_adaptive(world *w, sph_index first, sph_index last)
{
    sph_density_options d;
    sph_density_out o = {0};
    sph_index i;
    d.list_radius = at(w, REACH);
    d.eta = SPH_R(1.2);
    d.tolerance = BY_PRECISION(SPH_R(1e-13), SPH_R(1e-5));
    o.h = OUT(0);
    o.rho = OUT(1);
    o.omega = OUT(2);
    o.status = w->status;
    for (i = first; i < last; i++) o.h[i] = w->a[H][i];
    return sph_density_adaptive(SWEEP, at(w, M), d, o);
}
static sph_derivatives_out derivatives_into(const world *w)
{
    return cloud_derivatives_out(w->out, w->status);
}
OPERATOR(gradient_cspm, sph_gradient_cspm(SWEEP, at(w, F), derivatives_into(w)))
OPERATOR(derivatives_cspm, sph_derivatives_cspm(SWEEP, at(w, F), (sph_derivatives_options){0}, derivatives_into(w)))
OPERATOR(derivatives_icspm, sph_derivatives_icspm(SWEEP, at(w, F), (sph_derivatives_options){0}, derivatives_into(w)))
OPERATOR(derivatives_wls, sph_derivatives_wls(SWEEP, at(w, F), (sph_derivatives_options){0}, derivatives_into(w)))

OPERATOR(derivatives_fatehi, sph_derivatives_fatehi_manzari(SWEEP, at(w, F), (sph_derivatives_options){0}, derivatives_into(w)))
static sph_index fit_of(world *w, sph_index first, sph_index last, int liu)
{
    sph_cloud c = FRAME;
    const sph_sources s = {c.points, c.volume};
    const sph_interpolation_options o = {0};
    sph_interpolation_out out = {0};
    out.value = OUT(3);
    out.gx = OUT(0);
    out.gy = OUT(1);
    out.gz = OUT(2);
    out.status = w->status;
    return liu ? sph_interpolate_liu(KERNEL, w->c.dim, c, s, at(w, F), o, out) : sph_interpolate_mls(KERNEL, w->c.dim, c, s, at(w, F), o, out);
}
OPERATOR(fit_mls, fit_of(w, first, last, 0))
OPERATOR(fit_liu, fit_of(w, first, last, 1))

static sph_index msph_rows(world *w, sph_index first, sph_index last)
{
    sph_real *const row = (sph_real *)cloud_memory((size_t)w->c.start[w->c.n], sizeof *row);
    sph_rows_out o = {0};
    sph_index failed;
    o.row = row;
    o.diagonal = OUT(1);
    failed = sph_elliptic_rows_msph(SWEEP, at(w, MU), (sph_elliptic_options){0}, o);
    if (!failed) failed = sph_rows_apply(FRAME, row, sph_scalars_array(OUT(1)), at(w, F), sph_scalar_out_array(OUT(0), 0));
    free(row);
    return failed;
}
OPERATOR(fluid_monaghan, sph_fluid_rates_monaghan(SWEEP, fluid(w), (sph_fluid_out){.acceleration = into(w, 0), .rate = OUT(3), .heating = OUT(4)}))
OPERATOR(fluid_colagrossi, sph_fluid_rates_colagrossi(SWEEP, fluid(w), (sph_fluid_out){.acceleration = into(w, 0), .rate = OUT(3), .heating = OUT(4)}))
OPERATOR(fluid_hu_adams, sph_fluid_rates_hu_adams(SWEEP, fluid(w), (sph_fluid_out){.acceleration = into(w, 0), .rate = OUT(3), .heating = OUT(4)}))
static sph_riemann_options riemann(const world *w)
{
    sph_riemann_options o;
    o.limiter = SPH_R(0.4);
    o.gravity = w->gravity;
    return o;
}
OPERATOR(fluid_riemann, sph_fluid_rates_riemann(SWEEP, fluid(w), riemann(w), (sph_fluid_out){.acceleration = into(w, 0), .rate = OUT(3), .heating = OUT(4)}))
static sph_tension tension(const world *w)
{
    sph_tension t;
    t.rho = at(w, RHO);
    t.normal = vectors(w, BX);
    t.sigma = SPH_R(0.8);
    t.least = SPH_R(-1);
    return t;
}
OPERATOR(tension_css, sph_tension_css(SWEEP, tension(w), into(w, 0)))
OPERATOR(tension_csf, sph_tension_csf(SWEEP, tension(w), (sph_tension_out){.acceleration = into(w, 0), .curvature = OUT(3), .status = w->status}))
static sph_wall_terms wall_terms(const world *w)
{
    sph_wall_terms t;
    t.gamma = at(w, RHO);
    t.gradient = vectors(w, BX);
    t.value = at(w, U);
    t.slope = vectors(w, VX);
    return t;
}
/* the terms of the wall that are given keep their numbers when the unit changes: they are left out of it */
static sph_index wall_gradient(world *w, sph_index first, sph_index last)
{
    sph_wall_terms t = wall_terms(w);
    static const sph_real none = 0;
    t.value = sph_scalars_same(&none);
    return sph_wall_gradient(SWEEP, t, at(w, F), into(w, 0));
}
OPERATOR(pressure_factor, sph_pressure_factor_dfsph(SWEEP, fluid(w), at(w, SHARE), SCALAR_OUT))
static sph_index wall_gamma(world *w, sph_index first, sph_index last)
{
    sph_wall_elements e;
    sph_wall_gamma_out o = {0};
    memset(&e, 0, sizeof e);
    e.n = ELEMENTS;
    e.a = sph_vectors_separate(w->corner[0][0], w->corner[0][1], w->corner[0][2]);
    e.b = sph_vectors_separate(w->corner[1][0], w->corner[1][1], w->corner[1][2]);
    e.c = sph_vectors_separate(w->corner[2][0], w->corner[2][1], w->corner[2][2]);
    o.gamma = OUT(3);
    o.gradient = into(w, 0);
    return sph_wall_gamma(SWEEP, e, o);
}
static sph_index wall_laplacian(world *w, sph_index first, sph_index last)
{
    sph_wall_terms t = wall_terms(w);
    static const sph_real none = 0;
    t.slope.x = t.slope.y = t.slope.z = sph_scalars_same(&none);
    return sph_wall_laplacian(SWEEP, t, at(w, F), SCALAR_OUT);
}
static sph_index wall_of(world *w, sph_index first, sph_index last, sph_vectors velocity, sph_vectors normal)
{
    sph_wall s;
    sph_wall_out o = {0};
    s.share = at(w, SHARE);
    s.rho = at(w, RHO);
    s.p = at(w, P);
    s.v = vectors(w, VX);
    s.velocity = velocity;
    s.normal = normal;
    s.gravity = w->gravity;
    o.p = OUT(3);
    o.v = into(w, 0);
    o.status = w->status;
    return sph_wall_adami(SWEEP, s, o);
}
OPERATOR(wall, wall_of(w, first, last, vectors(w, BX), sph_vectors_separate(0, 0, 0)))
OPERATOR(wall_slips, wall_of(w, first, last, vectors(w, VX), vectors(w, BX)))
static sph_index collisions(world *w, sph_index first, sph_index last)
{
    sph_index *const count = (sph_index *)cloud_memory((size_t)w->c.n, sizeof *count), failed;
    sph_collision c;
    c.distance = SPH_R(1.05) * SPH_R(w->c.dx);
    c.restitution = SPH_R(0.8);
    c.inverse_mass = at(w, M);
    failed = sph_collision_count(w->c.dim, all(w), c, vectors(w, VX), count);
    if (!failed)
        failed = sph_collision_change_weighted(w->c.dim, FRAME, c, vectors(w, VX), count, into(w, 0));
    free(count);
    return failed;
}
static sph_index mhd(world *w, sph_index first, sph_index last)
{
    sph_mhd s;
    sph_mhd_out o = {0};
    s.medium = gas(w);
    s.p = at(w, P);
    s.u = at(w, U);
    s.cs = at(w, CS);
    s.alpha = s.alpha_B = at(w, ALPHA);
    s.v = vectors(w, VX);
    s.field = vectors(w, BX);
    s.psi = at(w, PSI);
    s.ch = SPH_R(1.3);
    s.sigma = w->sigma;
    s.beta = SPH_R(2);
    s.alpha_u = SPH_R(0.9);
    s.tensile = SPH_R(0.8);
    o.acceleration = into(w, 0);
    o.rate_B = into(w, 3);
    o.rate_u = OUT(6);
    o.rate_psi = OUT(7);
    o.div_B = OUT(8);
    o.div_v = OUT(9);
    o.v_sig = OUT(10);
    return sph_mhd_rates(SWEEP, s, o);
}
static sph_gas plain_gas(const world *w, int conductivity)
{
    sph_gas s;
    s.medium = gas(w);
    s.p = at(w, P);
    s.u = at(w, U);
    s.cs = at(w, CS);
    s.alpha = at(w, ALPHA);
    s.v = vectors(w, VX);
    s.beta = SPH_R(2);
    s.alpha_u = SPH_R(0.9);
    s.conductivity = conductivity;
    return s;
}
static sph_index gas_rates(world *w, sph_index first, sph_index last, int conductivity)
{
    sph_gas_out o = {0};
    o.acceleration = into(w, 0);
    o.rate_u = OUT(3);
    o.div_v = OUT(4);
    o.v_sig = OUT(5);
    return sph_gas_rates(SWEEP, plain_gas(w, conductivity), o);
}
OPERATOR(gas_plain, gas_rates(w, first, last, SPH_CONDUCTIVITY_NONE))
OPERATOR(gas_price, gas_rates(w, first, last, SPH_CONDUCTIVITY_PRICE))
OPERATOR(gas_wadsley, gas_rates(w, first, last, SPH_CONDUCTIVITY_WADSLEY))
static sph_velocity_gradient_out flow_into(world *w)
{
    sph_velocity_gradient_out o = {0};
    o.div = OUT(0);
    o.curl = OUT(1);
    o.shear = OUT(2);
    o.square = OUT(3);
    return o;
}
OPERATOR(flow_difference, sph_velocity_gradient_difference(SWEEP, gas(w), vectors(w, VX), flow_into(w)))
OPERATOR(flow_cspm, sph_velocity_gradient_cspm(SWEEP, vectors(w, VX), flow_into(w)))
static sph_index shock_indicator(world *w, sph_index first, sph_index last)
{
    sph_shock_out o = {0};
    o.ratio = OUT(0);
    o.v_sig = OUT(1);
    return sph_shock_indicator(SWEEP, plain_gas(w, SPH_CONDUCTIVITY_NONE), at(w, F), o);
}
static sph_index resistivity_ohmic(world *w, sph_index first, sph_index last)
{
    sph_ohmic s;
    sph_ohmic_out o = {0};
    s.medium = gas(w);
    s.eta = at(w, MU);
    s.field = vectors(w, BX);
    o.rate_B = into(w, 0);
    o.rate_u = OUT(3);
    return sph_resistivity_ohmic(SWEEP, s, o);
}

/* Corrections of all particles first, then the operator for its targets. */
enum { OF_INTERPOLATION, OF_GRADIENT, OF_CRK, OF_IAD };
static sph_index reproducing(world *w, sph_index first, sph_index last, int which)
{
    const size_t n = (size_t)w->c.n;
    const int dim = w->c.dim;
    sph_real *const room = (sph_real *)cloud_memory(25 * n, sizeof *room);
    sph_rk_out o = {0};
    sph_rk r;
    sph_correction_out c = {0};
    sph_corrected_out rates = {0};
    sph_index failed;
    o.scale = room;
    o.slope = sph_vector_out_separate(room + n, room + 2 * n, room + 3 * n);
    o.scale_gradient = sph_vector_out_separate(room + 4 * n, room + 5 * n, room + 6 * n);
    o.slope_gradient = sph_matrix_out_packed(dim, room + 7 * n);
    r.scale = sph_scalars_array(room);
    r.slope = sph_vectors_separate(room + n, room + 2 * n, room + 3 * n);
    r.scale_gradient = sph_vectors_separate(room + 4 * n, room + 5 * n, room + 6 * n);
    r.slope_gradient = sph_matrices_packed(dim, room + 7 * n);
    c.inverse = sph_matrix_out_packed(dim, room + 16 * n);
    rates.acceleration = into(w, 0);
    rates.rate_u = OUT(3);
    failed = which == OF_IAD ? sph_gradient_correction_iad(KERNEL, dim, all(w), c) : sph_rk_correction(KERNEL, dim, all(w), o);
    if (!failed && which == OF_INTERPOLATION) failed = sph_interpolate_rk(SWEEP, r, at(w, F), SCALAR_OUT);
    if (!failed && which == OF_GRADIENT) failed = sph_gradient_rk(SWEEP, r, at(w, F), into(w, 0));
    if (!failed && which == OF_CRK) failed = sph_gas_rates_crk(SWEEP, fluid(w), r, rates);
    if (!failed && which == OF_IAD) failed = sph_gas_rates_iad(SWEEP, fluid(w), sph_matrices_packed(dim, room + 16 * n), rates);
    free(room);
    return failed;
}
OPERATOR(interpolate_rk, reproducing(w, first, last, OF_INTERPOLATION))
OPERATOR(gradient_rk, reproducing(w, first, last, OF_GRADIENT))
OPERATOR(gas_crk, reproducing(w, first, last, OF_CRK))
OPERATOR(gas_iad, reproducing(w, first, last, OF_IAD))
OPERATOR(gradient_iad, sph_gradient_iad(SWEEP, at(w, F), derivatives_into(w)))
/* M = mu + B B^T, which turns with B */
static sph_index elliptic_tensor(world *w, sph_index first, sph_index last)
{
    const int dim = w->c.dim;
    sph_real *const m = (sph_real *)cloud_memory((size_t)(w->c.n * dim * dim), sizeof *m);
    sph_index i, failed;
    int a, b;
    for (i = 0; i < w->c.n; i++)
        for (a = 0; a < dim; a++)
            for (b = 0; b < dim; b++) m[((int)i * dim + a) * dim + b] = w->a[BX + a][i] * w->a[BX + b][i] + (a == b ? w->a[MU][i] : SPH_R(0));
    failed = sph_elliptic_tensor(SWEEP, sph_matrices_packed(dim, m), at(w, F), SCALAR_OUT);
    free(m);
    return failed;
}
static sph_index solid(world *w, sph_index first, sph_index last)
{
    const size_t n = (size_t)w->c.n;
    const int dim = w->c.dim;
    sph_real *const room = (sph_real *)cloud_memory(30 * n, sizeof *room), *const x[3] = {room + 27 * n, room + 28 * n, room + 29 * n};
    const sph_real *const from[3] = {w->c.x, w->c.y, w->c.z};
    const sph_matrices inverse = sph_matrices_packed(dim, room), gradient = sph_matrices_packed(dim, room + 9 * n), stress = sph_matrices_packed(dim, room + 18 * n);
    const sph_elastic law = sph_elastic_of(SPH_R(3), SPH_R(0.3));
    sph_correction_out c = {0};
    sph_solid s;
    sph_index i, failed;
    int a;
    for (i = 0; i < w->c.n; i++)
        for (a = 0; a < dim; a++) x[a][i] = from[a][i] + SPH_R(0.05) * w->a[H][i] * w->a[VX + a][i];
    c.inverse = sph_matrix_out_packed(dim, room);
    failed = sph_gradient_correction_cspm(KERNEL, dim, all(w), c);
    if (!failed) failed = sph_deformation_gradient(KERNEL, dim, all(w), sph_points_separate(w->c.n, x[0], x[1], x[2]), inverse, sph_matrix_out_packed(dim, room + 9 * n));
    for (i = 0; i < w->c.n; i++)
        sphi_store_matrix(dim, sph_matrix_out_packed(dim, room + 18 * n), i, sph_stress_neo_hookean(dim, sphi_matrix_at(dim, gradient, i), law));
    s.inverse = inverse;
    s.gradient = gradient;
    s.stress = stress;
    s.density = at(w, RHO);
    s.modulus = at(w, MU);
    s.hourglass = SPH_R(0.7);
    s.x = sph_points_separate(w->c.n, x[0], x[1], x[2]);
    if (!failed) failed = sph_solid_acceleration(SWEEP, s, into(w, 0));
    free(room);
    return failed;
}

/* what an output is; its power of length is a + b dim (masses, densities and speeds keep their numbers when the unit changes, volumes do not) */
typedef enum kind { END, SCALAR, VECTOR, AXIAL, SYMMETRIC } kind;
typedef struct output {
    kind is;
    int at, a, b;
} output;
typedef struct operation {
    const char *name;
    operator_fn *call;
    int dims;    /* bits 1, 2, 3 */
    double hard; /* how much more rounding than a sum */
    output out[8];
} operation;
enum { ALL = 14, PLANE = 4, SPACE = 8 };

static const operation operations[] = {
    {"shepard_sum", shepard_sum, ALL, 1, {{SCALAR, 0, 0, 0}}},
    {"interpolate_shepard", interpolate, ALL, 1, {{SCALAR, 0, 0, 0}}},
    {"density_summation", density_summation, ALL, 1, {{SCALAR, 0, 0, -1}}},
    {"density_number", density_number, ALL, 1, {{SCALAR, 0, 0, -1}}},
    {"density_adaptive", density_adaptive, ALL, 20, {{SCALAR, 0, 1, 0}, {SCALAR, 1, 0, -1}, {SCALAR, 2, 0, 0}}},
    {"gradient_difference", gradient_difference, ALL, 1, {{VECTOR, 0, -1, 0}}},
    {"gradient_cspm", gradient_cspm, ALL, 5, {{VECTOR, 0, -1, 0}}},
    {"gradient_iad", gradient_iad, ALL, 5, {{VECTOR, 0, -1, 0}}},
    {"interpolate_rk", interpolate_rk, ALL, 20, {{SCALAR, 0, 0, 0}}},
    {"gradient_rk", gradient_rk, ALL, 20, {{VECTOR, 0, -1, 0}}},
    {"gas_rates_crk", gas_crk, ALL, 20, {{VECTOR, 0, -1, 1}, {SCALAR, 3, -1, 1}}},
    {"gas_rates_iad", gas_iad, ALL, 20, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}}},
    {"elliptic_tensor", elliptic_tensor, ALL, 4000, {{SCALAR, 0, -2, 0}}},
    {"solid_acceleration", solid, ALL, 20, {{VECTOR, 0, -1, 0}}},
    {"laplacian_brookshaw", laplacian_brookshaw, ALL, 1, {{SCALAR, 0, -2, 0}}},
    {"derivatives_cspm", derivatives_cspm, ALL, 200, {{VECTOR, 0, -1, 0}, {SYMMETRIC, 3, -2, 0}, {SCALAR, 9, -2, 0}}},
    {"derivatives_icspm", derivatives_icspm, ALL, 4000, {{VECTOR, 0, -1, 0}, {SYMMETRIC, 3, -2, 0}, {SCALAR, 9, -2, 0}}},
    {"derivatives_wls", derivatives_wls, ALL, 4000, {{VECTOR, 0, -1, 0}, {SYMMETRIC, 3, -2, 0}, {SCALAR, 9, -2, 0}}},
    {"elliptic_brookshaw", elliptic_brookshaw, ALL, 1, {{SCALAR, 0, -2, 0}}},
    {"elliptic_brookshaw_corrected", elliptic_corrected, ALL, 5, {{SCALAR, 0, -2, 0}}},
    {"elliptic_schwaiger", elliptic_schwaiger, ALL, 20, {{SCALAR, 0, -2, 0}}},
    {"elliptic_msph", elliptic_msph, ALL, 20, {{SCALAR, 0, -2, 0}}},
    {"elliptic_rows_msph", msph_rows, ALL, 20, {{SCALAR, 0, -2, 0}, {SCALAR, 1, -2, 0}}},
    {"fluid_rates_monaghan", fluid_monaghan, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}}},
    {"fluid_rates_colagrossi", fluid_colagrossi, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}}},
    {"fluid_rates_hu_adams", fluid_hu_adams, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}}},
    {"fluid_rates_riemann", fluid_riemann, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}}},
    {"tension_css", tension_css, PLANE | SPACE, 1, {{VECTOR, 0, -1, 0}}},
    {"tension_csf", tension_csf, ALL, 5, {{VECTOR, 0, -1, 0}, {SCALAR, 3, -1, 0}}},
    {"wall_gradient", wall_gradient, ALL, 1, {{VECTOR, 0, -1, 0}}},
    {"wall_laplacian", wall_laplacian, ALL, 1, {{SCALAR, 0, -2, 0}}},
    /* the closed forms are differences of powers up to q^14: in float 280 roundings were seen */
    {"wall_gamma", wall_gamma, ALL, 20, {{VECTOR, 0, -1, 0}, {SCALAR, 3, 0, 0}}},
    {"pressure_factor_dfsph", pressure_factor, ALL, 1, {{SCALAR, 0, 2, 2}}},
    {"viscous_mu_morris", viscous_morris, ALL, 1, {{VECTOR, 0, -2, -1}}},
    {"viscous_mu_monaghan_cleary", viscous_cleary, ALL, 1, {{VECTOR, 0, -2, -1}}},
    {"viscous_mu_espanol_revenga", viscous_espanol, ALL, 1, {{VECTOR, 0, -2, -1}}},
    {"elliptic_basic_degiuli_ban", elliptic_basic, ALL, 20, {{SCALAR, 0, -2, 0}}},
    {"derivatives_fatehi_manzari", derivatives_fatehi, ALL, 4000, {{VECTOR, 0, -1, 0}, {SYMMETRIC, 3, -2, 0}, {SCALAR, 9, -2, 0}}},
    {"interpolate_mls", fit_mls, ALL, 20, {{VECTOR, 0, -1, 0}, {SCALAR, 3, 0, 0}}},
    {"interpolate_liu", fit_liu, ALL, 20, {{VECTOR, 0, -1, 0}, {SCALAR, 3, 0, 0}}},
    {"velocity_xsph", xsph, ALL, 1, {{VECTOR, 0, 0, -1}}},
    {"wall_adami", wall, ALL, 1, {{VECTOR, 0, 0, 0}, {SCALAR, 3, 0, 0}}},
    {"wall_adami-free-slip", wall_slips, ALL, 1, {{VECTOR, 0, 0, 0}, {SCALAR, 3, 0, 0}}},
    {"density_diffusion_molteni", diffusion_molteni, ALL, 1, {{SCALAR, 0, -1, 0}}},
    {"free_surface", free_surface, ALL, 20, {{VECTOR, 0, 0, 0}, {SCALAR, 3, 0, 0}, {SCALAR, 4, 0, 0}}},
    /* the fourth power of W / W(dx) has four times the roundings of W */
    {"shift_displacement", shifted, ALL, 4, {{VECTOR, 0, -1, 0}}},
    {"shift_rates", shift_rates, ALL, 1, {{VECTOR, 0, -1, 0}, {SCALAR, 3, -1, 0}}},
    {"transport_adami", transport, ALL, 1, {{VECTOR, 0, -1, -1}, {VECTOR, 3, -1, -1}}},
    {"collision_change_weighted", collisions, ALL, 1, {{VECTOR, 0, 0, 0}}},
    {"nearest_distance", nearest_distance, ALL, 1, {{SCALAR, 0, 1, 0}}},
    {"hexatic_order", hexatic_order, PLANE, 5, {{SCALAR, 0, 0, 0}}},
    {"mhd_rates",
     mhd,
     ALL,
     1,
     {{VECTOR, 0, -1, -1}, {VECTOR, 3, -1, -1}, {SCALAR, 6, -1, -1}, {SCALAR, 7, -1, -1}, {SCALAR, 8, -1, -1}, {SCALAR, 9, -1, -1}, {SCALAR, 10, 0, 0}}},
    {"gas_rates", gas_plain, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}, {SCALAR, 5, 0, 0}}},
    {"gas_rates_price", gas_price, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}, {SCALAR, 5, 0, 0}}},
    {"gas_rates_wadsley", gas_wadsley, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}, {SCALAR, 5, 0, 0}}},
    {"velocity_gradient_difference", flow_difference, PLANE | SPACE, 5, {{SCALAR, 0, -1, -1}, {SCALAR, 1, -1, -1}, {SCALAR, 2, -2, -2}, {SCALAR, 3, -2, -2}}},
    {"velocity_gradient_cspm", flow_cspm, PLANE | SPACE, 20, {{SCALAR, 0, -1, 0}, {SCALAR, 1, -1, 0}, {SCALAR, 2, -2, 0}, {SCALAR, 3, -2, 0}}},
    {"shock_indicator", shock_indicator, ALL, 1, {{SCALAR, 0, 0, -1}, {SCALAR, 1, 0, 0}}},
    {"resistivity_ohmic", resistivity_ohmic, ALL, 1, {{VECTOR, 0, -2, -1}, {SCALAR, 3, -2, -1}}},
    {"cleaning_rates", cleaning, ALL, 1, {{VECTOR, 0, -1, -1}, {SCALAR, 3, -1, -1}, {SCALAR, 4, -1, -1}}},
    {"divergence_difference", divergence_difference, ALL, 1, {{SCALAR, 0, -1, -1}}},
    {"divergence_symmetric", divergence_symmetric, ALL, 1, {{SCALAR, 0, -1, -1}}},
    {"gradient_symmetric", gradient_symmetric, ALL, 1, {{VECTOR, 0, -1, -1}}},
    {"curl_difference", curl_difference, PLANE | SPACE, 1, {{AXIAL, 0, -1, -1}}},
    {"gravity_direct", gravity_direct, SPACE, 1, {{VECTOR, 0, -2, 0}, {SCALAR, 3, -1, 0}}},
    {"gravity_zeta", gravity_zeta, SPACE, 10, {{SCALAR, 0, -1, 0}}},
    {"gravity_correction", gravity_correction, SPACE, 1, {{VECTOR, 0, -4, 0}}}};
enum { OPERATIONS = (int)(sizeof operations / sizeof *operations) };

/* ---- the same cloud, seen differently ---- */

typedef struct view {
    const char *name;
    double unit, turn[3][3], shift[3], determinant, lost; /* lost: roundings of positions, in roundings of the spacing */
    int renames;
} view;

static view view_new(const char *name)
{
    view v;
    int a;
    memset(&v, 0, sizeof v);
    v.name = name;
    v.unit = v.determinant = v.lost = 1.0;
    for (a = 0; a < 3; a++) v.turn[a][a] = 1.0;
    return v;
}
/* turned in the plane of the axes a and b */
static void view_turn(view *v, int a, int b, double angle)
{
    const double c = cos(angle), s = sin(angle);
    int k;
    for (k = 0; k < 3; k++) {
        const double p = v->turn[a][k], q = v->turn[b][k];
        v->turn[a][k] = c * p - s * q;
        v->turn[b][k] = s * p + c * q;
    }
}
static void turned(const view *v, const double *from, double *to)
{
    int a;
    for (a = 0; a < 3; a++) to[a] = v->turn[a][0] * from[0] + v->turn[a][1] * from[1] + v->turn[a][2] * from[2];
}
static sph_index new_name(const view *v, sph_index i, sph_index n) { return v->renames ? (sph_index)((i * (int64_t)7 + 3) % n) : i; }

static world seen(const world *w, const view *v)
{
    world s = world_new(w->c.dim, w->c.n);
    const sph_index n = w->c.n;
    double p[3], q[3];
    sph_index i, k, *old = (sph_index *)cloud_memory((size_t)n, sizeof *old);
    int f;
    s.sigma = SPH_R(pow(v->unit, -w->c.dim)); /* so that all of the rate of psi has one power of length */
    s.c.dx = w->c.dx * v->unit;
    p[0] = (double)w->gravity.x;
    p[1] = (double)w->gravity.y;
    p[2] = (double)w->gravity.z;
    turned(v, p, q);
    s.gravity.x = SPH_R(q[0] / v->unit);
    s.gravity.y = SPH_R(q[1] / v->unit);
    s.gravity.z = SPH_R(q[2] / v->unit);
    for (i = 0; i < n; i++) {
        const sph_index j = new_name(v, i, n);
        old[j] = i;
        cloud_position(&w->c, i, p);
        turned(v, p, q);
        s.c.x[j] = SPH_R(v->unit * q[0] + v->shift[0]);
        s.c.y[j] = SPH_R(v->unit * q[1] + v->shift[1]);
        s.c.z[j] = SPH_R(v->unit * q[2] + v->shift[2]);
        for (f = 0; f < VX; f++) s.a[f][j] = w->a[f][i] * SPH_R(f == H || f == REACH ? v->unit : f == V ? pow(v->unit, w->c.dim) : 1.0);
        for (f = VX; f < FIELDS; f += 3) {
            int a;
            for (a = 0; a < 3; a++) p[a] = (double)w->a[f + a][i];
            turned(v, p, q);
            for (a = 0; a < 3; a++) s.a[f + a][j] = SPH_R(q[a]);
        }
    }
    for (i = 0; i < ELEMENTS; i++)
        for (f = 0; f < 3; f++) {
            const int to = v->determinant < 0.0 && w->c.dim > 1 ? w->c.dim - 1 - f : f; /* the order of corners says where the fluid is */
            int a;
            for (a = 0; a < 3; a++) p[a] = (double)w->corner[f][a][i];
            turned(v, p, q);
            for (a = 0; a < w->c.dim; a++) s.corner[to < 0 ? 2 : to][a][i] = SPH_R(v->unit * q[a] + v->shift[a]);
        }
    s.c.index = (sph_index *)cloud_memory((size_t)w->c.start[n], sizeof *s.c.index);
    for (i = 0; i < n; i++) { /* the same neighbours; with new names also in another order */
        const sph_index from = w->c.start[old[i]], count = w->c.start[old[i] + 1] - from;
        s.c.start[i + 1] = s.c.start[i] + count;
        for (k = 0; k < count; k++) s.c.index[s.c.start[i] + (v->renames ? count - 1 - k : k)] = new_name(v, w->c.index[from + k], n);
    }
    free(old);
    return s;
}

/* what the first result must be in the view; to: up to six components */
static int expected(const view *v, const world *w, const output *o, sph_index i, double *to)
{
    const double scale = pow(v->unit, o->a + o->b * w->c.dim);
    double h[3][3], p[3] = {0, 0, 0}, q[3];
    int a, b, c, d, parts = o->is == SCALAR ? 1 : o->is == SYMMETRIC ? w->c.dim * (w->c.dim + 1) / 2 : o->is == AXIAL ? 3 : w->c.dim;
    static const int row[] = {0, 0, 1, 0, 1, 2}, column[] = {0, 1, 1, 2, 2, 2};
    if (o->is == SCALAR) to[0] = (double)w->out[o->at][i];
    else if (o->is == SYMMETRIC) {
        memset(h, 0, sizeof h);
        for (a = 0; a < parts; a++) h[row[a]][column[a]] = h[column[a]][row[a]] = (double)w->out[o->at + a][i];
        for (a = 0; a < parts; a++)
            for (b = 0, to[a] = 0.0; b < 3; b++)
                for (c = 0; c < 3; c++) to[a] += v->turn[row[a]][b] * h[b][c] * v->turn[column[a]][c];
    } else {
        for (a = 0; a < parts; a++) p[a] = (double)w->out[o->at + a][i];
        turned(v, p, q);
        for (a = 0; a < parts; a++) to[a] = q[a] * (o->is == AXIAL ? v->determinant : 1.0);
    }
    for (d = 0; d < parts; d++) to[d] *= scale;
    return parts;
}

static void check_view(const operation *op, const world *w, const view *v)
{
    world s = seen(w, v);
    const output *o;
    sph_index i;
    CHECK(op->call(&s, 0, s.c.n) == 0);
    for (o = op->out; o->is != END; o++) {
        double worst = 0.0, size = 0.0, want[6];
        int a, parts;
        for (i = 0; i < w->c.n; i++) {
            parts = expected(v, w, o, i, want);
            for (a = 0; a < parts; a++) {
                const double off = fabs(want[a] - (double)s.out[o->at + a][new_name(v, i, w->c.n)]);
                if (!(off <= worst)) worst = off;
                size = fmax(size, fabs(want[a]));
            }
        }
        CHECK(size > 0.0);
        if (!(worst <= 100.0 * op->hard * v->lost * EPSILON * size))
            fprintf(stderr, "sph_%s, output %d, %dD, %s:\n", op->name, (int)(o - op->out), w->c.dim, v->name);
        CHECK_CLOSE(worst, 0.0, 100.0 * op->hard * v->lost * EPSILON * size);
    }
    world_free(&s);
}

/* bit for bit the same by ranges, of clouds that were checked, too, in any order; by the threads of a host too, where
   this is compiled with OpenMP (tests/lint/lint.sh) */
static void check_pieces(const operation *op, world *w)
{
    const sph_index n = w->c.n, cut[] = {0, 1, n / 3, n / 3, n - 2, n};
    const size_t size = (size_t)n * sizeof(sph_real);
    sph_real *const whole = (sph_real *)cloud_memory(OUTPUTS, size);
    sph_index failed[5];
    int k;
    for (k = 0; k < OUTPUTS; k++) memcpy(whole + k * n, w->out[k], size);
    for (k = 0; k < OUTPUTS; k++) memset(w->out[k], 0, size);
#if defined(_OPENMP)
#pragma omp parallel for schedule(dynamic, 1)
#endif
    for (k = 4; k >= 0; k--) failed[k] = op->call(w, cut[k], cut[k + 1]);
    for (k = 0; k < 5; k++) CHECK(failed[k] == 0);
    for (k = 0; k < OUTPUTS; k++) CHECK(memcmp(whole + k * n, w->out[k], size) == 0);
    for (k = 0; k < OUTPUTS; k++) memset(w->out[k], 0, size);
    w->marked = 1;
    for (k = 0; k < 5; k++) CHECK(op->call(w, cut[k], cut[k + 1]) == 0);
    w->marked = 0;
    for (k = 0; k < OUTPUTS; k++) CHECK(memcmp(whole + k * n, w->out[k], size) == 0);
    free(whole);
}

static void check_operation(const operation *op, world *w)
{
    view v;
    int k;
    for (k = 0; k < OUTPUTS; k++) memset(w->out[k], 0, (size_t)w->c.n * sizeof(sph_real));
    CHECK(op->call(w, 0, w->c.n) == 0);
    v = view_new("another origin");
    v.shift[0] = 0.7;
    v.shift[1] = w->c.dim > 1 ? -1.3 : 0.0;
    v.shift[2] = w->c.dim > 2 ? 0.4 : 0.0;
    check_view(op, w, &v);
    v = view_new("far away"); /* pair vectors lose the digits that the positions have in common */
    v.shift[0] = 300.0;
    v.lost = 300.0 / w->c.dx;
    if (op->call != collisions) check_view(op, w, &v); /* a pair either collides or not */
    v = view_new("turned");
    if (w->c.dim > 1) view_turn(&v, 0, 1, 0.7);
    if (w->c.dim > 2) view_turn(&v, 1, 2, -1.1);
    if (w->c.dim > 2) view_turn(&v, 0, 2, 2.3);
    check_view(op, w, &v);
    v.name = "mirrored";
    v.turn[0][0] = -v.turn[0][0];
    v.turn[0][1] = -v.turn[0][1];
    v.turn[0][2] = -v.turn[0][2];
    v.determinant = -1.0;
    check_view(op, w, &v);
    v = view_new("another unit of length");
    v.unit = 3.7;
    check_view(op, w, &v);
    v = view_new("other names");
    v.renames = 1;
    check_view(op, w, &v);
    check_pieces(op, w);
}
static void print_values(const operation *op, world *w)
{
    const output *o;
    sph_index i;
    (void)op->call(w, 0, w->c.n);
    for (o = op->out; o->is != END; o++) {
        const int parts = o->is == SCALAR ? 1 : o->is == SYMMETRIC ? w->c.dim * (w->c.dim + 1) / 2 : w->c.dim;
        int a;
        for (a = 0; a < parts; a++)
            for (i = 0; i < w->c.n; i++) printf("%s/%d/%d %g %.12g\n", op->name, w->c.dim, o->at, op->hard, (double)w->out[o->at + a][i]);
    }
}

int main(int argc, char **argv)
{
    const int values = argc > 1 && strcmp(argv[1], "-values") == 0;
    int dim, k;
    for (dim = 1; dim <= 3; dim++) {
        world w = first_world(dim);
        for (k = 0; k < OPERATIONS; k++)
            if (operations[k].dims >> dim & 1) {
                if (values) print_values(&operations[k], &w);
                else check_operation(&operations[k], &w);
            }
        world_free(&w);
    }
    return values ? 0 : check_report("test_invariance");
}
