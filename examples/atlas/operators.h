/* SPDX-License-Identifier: MIT
 *
 * operators.h - the table of the atlas: one line for each operator. A new operator appears by adding its line.
 *
 *     X(id, function, FAMILY, list, "formula", "source", "what to know", call)
 *
 * id        its page is id.html
 * function  whose comment in sph_ops.h is shown, and whose claims are compared with what is measured (see
 *           header.h: a line "Atlas: gradient exact for linear fields; order 2 inside lattices, ...")
 * FAMILY    what goes in and out, and what the result should be (families.h)
 * list      GATHER, MEAN or LARGER: the list that it needs where h varies; CLOSE or NONE
 * formula, source   must occur in sph_ops.h as they stand here, which the driver looks after
 * call      an expression of the kernel k, dim and the views a, which are below
 *
 * The calls are compiled twice: with k and dim known at run time (atlas_operators.c) and as constants, as in a
 * user's program (atlas_cost.c).
 */
#ifndef ATLAS_OPERATORS_H
#define ATLAS_OPERATORS_H

#include "sample.h"

/* h may grow by this factor from that of an even cloud: lists reach no farther. */
static const sph_real atlas_growth = SPH_R(1.5);
static const sph_real atlas_one = SPH_R(1), atlas_zero = SPH_R(0);

/* What calls are made of: the arrays of a sample as the headers' views. */
typedef struct views {
    sph_cloud cloud, probes; /* probes: the lists hold the particle itself, as those of probes do */
    sph_scalars f, m_f, mobility, one; /* m_f: masses V f, so that a density of 1 becomes f */
    sph_vectors v, none;               /* none: zero vectors */
    sph_scalar_out scalar;
    sph_vector_out vector, curl; /* curl: in 2D the third component is the first array */
    sph_derivatives_out gradient, hessian, laplacian;
    sph_interpolation_out value, slope;
    sph_velocity_gradient_out div_v;
    sph_rk rk;
    sph_wall_terms wall;
    sph_matrices iad, tensor;
    sph_medium medium;
    sph_fluid pressure, moving; /* p = f at rest; and v without pressure */
    sph_fluid_out rates;
    sph_corrected_out corrected;
    sph_cleaning psi, field; /* psi = f without B; and B = v without psi */
    sph_cleaning_out rate_B, div_B;
    sph_ohmic resistive; /* B = v, resistivity 1 */
    sph_ohmic_out heated;
    sph_shear_bulk mu; /* shear viscosity 1, bulk viscosity 0 */
    sph_sources sources;
    sph_derivatives_options second; /* all zeros are the defaults */
    sph_interpolation_options fit;
    sph_elliptic_options elliptic, trace;
    /* of operators that are not linear */
    sph_density_options own;
    sph_density_out own_h; /* h is the second array, omega the third */
    sph_fluid flow;        /* all that a fluid has, with the velocity v */
    sph_fluid_out lossy;   /* rate and heating are the fourth and the fifth array */
    sph_riemann_options riemann;
    sph_shift shift, tensile;
    sph_collision bounce;
    sph_scalar_out potential; /* the fourth array */
    double *in[3]; /* as given */
    const sample *s;
} views;

static inline sph_vectors atlas_vectors(sph_scalars x, sph_scalars y, sph_scalars z)
{
    sph_vectors v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

/* in: one array, or one for each component. out: likewise. Results that a family does not ask for are not
   written. */
static inline views views_of(const sample *s, double *const *in, double *const *out)
{
    const sph_scalars one = sph_scalars_same(&atlas_one), zero = sph_scalars_same(&atlas_zero), m = sph_scalars_array(s->volume);
    double *const *const c = s->correction;
    views a;
    memset(&a, 0, sizeof a);
    a.s = s;
    a.cloud = a.probes = s->cloud;
    a.probes.list = search_list(&s->with_self);
    a.probes.checked = 0;
    a.f = sph_scalars_array(in[0]);
    for (sph_index i = 0; i < s->n; i++) s->scratch[0][i] = s->volume[i] * in[0][i];
    a.m_f = sph_scalars_array(s->scratch[0]);
    a.mobility = sph_scalars_array(s->mobility);
    a.one = one;
    a.v = vectors_of(in, s->dim);
    a.none = atlas_vectors(zero, zero, zero);
    a.scalar = sph_scalar_out_array(out[0], s->status);
    a.vector = vectors_into(out, 3);
    a.curl = s->dim > 2 ? a.vector : sph_vector_out_separate(s->scratch[1], s->scratch[2], out[0]);
    a.gradient.stride = a.hessian.stride = a.laplacian.stride = a.value.stride = a.slope.stride = 1;
    a.gradient.status = a.hessian.status = a.laplacian.status = a.value.status = a.slope.status = s->status;
    a.gradient.conditioning = a.hessian.conditioning = a.laplacian.conditioning = a.value.conditioning = a.slope.conditioning = s->conditioning;
    a.gradient.gx = a.slope.gx = out[0];
    a.gradient.gy = a.slope.gy = out[1];
    a.gradient.gz = a.slope.gz = out[2];
    a.hessian.hxx = out[0];
    a.hessian.hxy = out[1];
    a.hessian.hyy = out[2];
    a.hessian.hxz = out[3];
    a.hessian.hyz = out[4];
    a.hessian.hzz = out[5];
    a.laplacian.laplacian = out[0];
    a.value.value = out[0];
    a.div_v.div = out[0];
    a.div_v.status = s->status;
    a.wall.gamma = sph_scalars_array(s->gamma);
    a.wall.gradient = vectors_of(s->wall_gradient, 3);
    a.wall.value = sph_scalars_array(s->wall_value);
    a.wall.slope = vectors_of(s->wall_slope, 3);
    a.rk.scale = sph_scalars_array(c[0]);
    a.rk.slope = vectors_of(c + 1, 3);
    a.rk.scale_gradient = vectors_of(c + 4, 3);
    a.rk.slope_gradient.x = vectors_of(c + 7, 3);
    a.rk.slope_gradient.y = vectors_of(c + 10, 3);
    a.rk.slope_gradient.z = vectors_of(c + 13, 3);
    {
        const sph_scalars xx = sph_scalars_array(c[16]), xy = sph_scalars_array(c[17]), xz = sph_scalars_array(c[18]), yy = sph_scalars_array(c[19]),
                          yz = sph_scalars_array(c[20]), zz = sph_scalars_array(c[21]);
        a.iad.x = atlas_vectors(xx, xy, xz);
        a.iad.y = atlas_vectors(xy, yy, yz);
        a.iad.z = atlas_vectors(xz, yz, zz);
    }
    a.tensor.x = atlas_vectors(a.mobility, zero, zero);
    a.tensor.y = atlas_vectors(zero, a.mobility, zero);
    a.tensor.z = atlas_vectors(zero, zero, a.mobility);
    a.medium.m = m;
    a.medium.rho = a.medium.omega = one;
    a.pressure.m = a.moving.m = m;
    a.pressure.rho = a.moving.rho = one;
    a.pressure.p = a.f;
    a.pressure.v = a.none;
    a.pressure.viscosity = (int)SPH_VISCOSITY_NONE;
    a.moving.p = zero;
    a.moving.v = a.v;
    a.rates.acceleration = a.corrected.acceleration = a.vector;
    a.rates.status = a.corrected.status = s->status;
    a.psi.medium = a.field.medium = a.medium;
    a.psi.psi = a.f;
    a.psi.field = a.none;
    a.field.psi = zero;
    a.field.field = a.v;
    a.psi.ch = a.field.ch = SPH_R(1);
    a.rate_B.rate_B = a.vector;
    a.rate_B.rate_psi = s->scratch[1];
    a.rate_B.status = a.div_B.status = s->status;
    a.div_B.rate_B = vectors_into(s->scratch, 3);
    a.div_B.rate_psi = s->conditioning; /* which it leaves free */
    a.div_B.div_B = out[0];
    a.resistive.medium = a.medium;
    a.resistive.eta = one;
    a.resistive.field = a.v;
    a.heated.rate_B = a.vector;
    a.heated.status = s->status;
    a.mu.shear = one;
    a.mu.bulk = zero;
    a.sources.points = s->cloud.points;
    a.sources.volume = s->cloud.volume;
    a.trace.trace = 1;
    a.own.list_radius = sph_scalars_same(&s->list_radius);
    a.own.eta = s->h_dx / atlas_growth;
    a.own_h.rho = out[0];
    a.own_h.h = out[1];
    a.own_h.omega = out[2];
    a.own_h.status = s->status;
    a.flow.m = sph_scalars_array(s->state[STATE_M]);
    a.flow.rho = sph_scalars_array(s->state[STATE_RHO]);
    a.flow.p = sph_scalars_array(s->state[STATE_P]);
    a.flow.c = sph_scalars_array(s->state[STATE_C]);
    a.flow.v = a.v;
    a.flow.viscosity = (int)SPH_VISCOSITY_MONAGHAN;
    a.flow.alpha = SPH_R(0.1);
    a.lossy.acceleration = a.vector;
    a.lossy.rate = out[3];
    a.lossy.heating = out[4];
    a.lossy.stride = 1;
    a.lossy.status = s->status;
    a.pressure.c = a.flow.c;
    a.shift.strength = a.tensile.strength = sph_scalars_same(&s->strength);
    a.shift.longest = a.tensile.longest = SPH_R(-1);
    a.tensile.tensile = SPH_R(0.2);
    a.tensile.spacing = SPH_R(1) / s->h_dx;
    a.bounce.distance = SPH_R(0.75) * s->spacing;
    a.bounce.restitution = SPH_R(0.5);
    a.bounce.inverse_mass = sph_scalars_array(s->state[STATE_W]);
    a.potential = sph_scalar_out_array(out[3], s->status);
    for (int q = 0; q < 3; q++) a.in[q] = in[q];
    return a;
}

/* Operators that come as rows only are applied as rows. */
SPH_FN sph_index atlas_anisotropic(sph_kernel k, int dim, const views *a)
{
    sph_diagonal mobility;
    sph_rows_out rows;
    sph_index failed;
    memset(&rows, 0, sizeof rows);
    mobility.x = mobility.y = mobility.z = a->mobility;
    rows.row = a->s->row;
    rows.conditioning = a->s->conditioning;
    rows.status = a->s->status;
    failed = sph_elliptic_rows_anisotropic(k, dim, a->cloud, mobility, rows);
    if (failed >= 0) expect(sph_rows_apply(a->cloud, rows.row, sph_scalars_none(), a->f, sph_scalar_out_array(a->scalar.p, NULL)));
    return failed;
}

/* The guess of h is that of an even cloud of the density 1. */
SPH_FN sph_index atlas_adaptive(sph_kernel k, int dim, const views *a)
{
    for (sph_index i = a->cloud.first; i < a->cloud.last; i++) a->own_h.h[i] = a->own.eta * a->s->spacing;
    return sph_density_adaptive(k, dim, a->cloud, a->m_f, a->own, a->own_h);
}

/* Collisions: the result is the change of the velocity. */
SPH_FN sph_index atlas_sequential(int dim, const views *a)
{
    double *const to[3] = {a->vector.x, a->vector.y, a->vector.z};
    for (int c = 0; c < dim; c++) memcpy(to[c], a->in[c], (size_t)a->s->n * sizeof *to[c]);
    const sph_index lost = sph_collision_sequential(dim, a->cloud, a->bounce, a->vector, NULL);
    for (int c = 0; c < dim; c++)
        for (sph_index i = 0; i < a->s->n; i++) to[c][i] -= a->in[c][i];
    return lost;
}
SPH_FN sph_index atlas_weighted(int dim, const views *a)
{
    expect(sph_collision_count(dim, a->cloud, a->bounce, a->v, a->s->collisions));
    return sph_collision_change_weighted(dim, a->cloud, a->bounce, a->v, a->s->collisions, a->vector);
}

enum list_kind { GATHER, MEAN, LARGER, CLOSE, NONE };
static inline const char *list_kind_text(int list)
{
    static const char *const text[] = {"gather: all with r < support of the target (SPH_GATHER)", "mean: all with r < support of the mean h (SPH_MEAN)",
                                       "both sides: all with r < the larger support (SPH_LARGER)",
                                       "all that are closer than the distance of collisions", "none: all pairs"};
    return text[list];
}

/* clang-format off */
#define ATLAS_OPERATORS(X) \
    X(interpolate_shepard, sph_interpolate_shepard, VALUE, GATHER, \
      "f_i = sum_j V_j f_j W_ij / sum_j V_j W_ij", "Shepard 1968", \
      "Robust: a mean with positive weights, which neither over- nor undershoots.", \
      sph_interpolate_shepard(k, dim, a.cloud, a.f, a.scalar)) \
    X(interpolate_mls, sph_interpolate_mls, VALUE, GATHER, \
      "g = w = V_j W", "Lancaster & Salkauskas 1981, Math. Comput. 37, 141", \
      "For probes and particles of another code. The value at a point whose neighbours are on one side is extrapolated.", \
      sph_interpolate_mls(k, dim, a.probes, a.sources, a.f, a.fit, a.value)) \
    X(interpolate_liu, sph_interpolate_liu, VALUE, GATHER, \
      "w = V_j W and g = -V_j F", "Liu & Liu 2006, Appl. Numer. Math. 56, 19", \
      "What walls by mirror points (mDBC) use.", \
      sph_interpolate_liu(k, dim, a.probes, a.sources, a.f, a.fit, a.value)) \
    X(interpolate_rk, sph_interpolate_rk, VALUE, GATHER, \
      "f_i = sum_j V_j f_j W^R_ij", "Frontiere, Raskin & Owen 2017, JCP 332, 160", \
      "Needs sph_rk_correction first; the cost of that is not in the one of this sweep.", \
      sph_interpolate_rk(k, dim, a.cloud, a.rk, a.f, a.scalar)) \
    X(density_summation, sph_density_summation, VALUE, GATHER, \
      "rho_i = sum_j m_j W_ij(h_i)", "Price & Monaghan 2004", \
      "Half a density at a free surface. Here the masses are V_j f_j, and f is the density that is looked for.", \
      sph_density_summation(k, dim, a.cloud, a.m_f, a.scalar)) \
    X(density_number, sph_density_number, VALUE, GATHER, \
      "rho_i = m_i sum_j W_ij(h_i)", "Hu & Adams 2006, JCP 213, 844", \
      "Keeps jumps of the mass of particles sharp. Here the masses are V_j f_j, and f is the density that is looked for.", \
      sph_density_number(k, dim, a.cloud, a.m_f, a.scalar)) \
    X(gradient_difference, sph_gradient_difference, GRADIENT, GATHER, \
      "grad f_i = sum_j V_j (f_j - f_i) grad_i W_ij", "Monaghan 1992, ARA&A 30, 543", \
      "Cheap, but in disorder and at boundaries its error does not fall with the spacing.", \
      sph_gradient_difference(k, dim, a.cloud, a.f, a.vector)) \
    X(gradient_symmetric, sph_gradient_symmetric, GRADIENT, LARGER, \
      "grad f_i = rho_i sum_j m_j (f_i g_i + f_j g_j) x_ij", "Price 2012, JCP 231, 759", \
      "Keeps momentum, and is not 0 for constants: it is a force between pairs, not an approximation to trust pointwise.", \
      sph_gradient_symmetric(k, dim, a.cloud, a.medium, a.f, a.vector)) \
    X(gradient_cspm, sph_gradient_cspm, GRADIENT, GATHER, \
      "grad f_i = K^-1 sum_j V_j (-F_ij) e (f_j - f_i)", "Randles & Libersky 1996, CMAME 139, 375", \
      "The gradient to take first: exact for linear fields anywhere. Does not conserve momentum.", \
      sph_gradient_cspm(k, dim, a.cloud, a.f, a.gradient)) \
    X(gradient_iad, sph_gradient_iad, GRADIENT, GATHER, \
      "grad f_i = C sum_j V_j W_ij e (f_j - f_i)", "Garcia-Senz, Cabezon & Escartin 2012, A&A 538, A9", \
      "As gradient_cspm, without derivatives of the kernel.", \
      sph_gradient_iad(k, dim, a.cloud, a.f, a.gradient)) \
    X(gradient_rk, sph_gradient_rk, GRADIENT, GATHER, \
      "grad f_i = sum_j V_j (f_j - f_i) grad W^R_ij", "Frontiere, Raskin & Owen 2017, JCP 332, 160", \
      "Needs sph_rk_correction first; the cost of that is not in the one of this sweep.", \
      sph_gradient_rk(k, dim, a.cloud, a.rk, a.f, a.vector)) \
    X(gradient_mls, sph_interpolate_mls, GRADIENT, GATHER, \
      "g = w = V_j W", "Lancaster & Salkauskas 1981, Math. Comput. 37, 141", \
      "The gradient of a linear fit that also fits the value: of probes, which have none of their own.", \
      sph_interpolate_mls(k, dim, a.probes, a.sources, a.f, a.fit, a.slope)) \
    X(gradient_icspm, sph_derivatives_icspm, GRADIENT, GATHER, \
      "df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...; g = -V_j F_ij and w = V_j W_ij / r^2", "Schilders & Anthonissen 2017, J. Appl. Math. Phys. 5, 168", \
      "The gradient that comes with the Hessian of the block system: second order at boundaries, too.", \
      sph_derivatives_icspm(k, dim, a.cloud, a.f, a.second, a.gradient)) \
    X(gradient_wls, sph_derivatives_wls, GRADIENT, GATHER, \
      "df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...; g = w = V_j W_ij", "weighted least-squares fit of a quadratic (moving least squares at the particle)", \
      "The gradient of a quadratic fit: second order at boundaries, too, at the price of the fit.", \
      sph_derivatives_wls(k, dim, a.cloud, a.f, a.second, a.gradient)) \
    X(wall_gradient, sph_wall_gradient, GRADIENT, GATHER, \
      "grad f = (sum_j V_j f_j grad_i W_ij - f_w grad gamma) / gamma", "Ferrand et al. 2013, IJNMF 71, 446", \
      "Walls without particles in them; all sides are walls here, and the field is given there. The sum form: compare it with gradient_symmetric.", \
      sph_wall_gradient(k, dim, a.cloud, a.wall, a.f, a.vector)) \
    X(pressure_monaghan, sph_fluid_rates_monaghan, PRESSURE, MEAN, \
      "a_i = -sum_j m_j (P_ij + Pi_ij) grad_i W_ij", "Monaghan 1992, (3.3)", \
      "Keeps momentum and angular momentum. The forms for jumps of density are the same where there is none, as here.", \
      sph_fluid_rates_monaghan(k, dim, a.cloud, a.pressure, a.rates)) \
    X(pressure_riemann, sph_fluid_rates_riemann, PRESSURE, MEAN, \
      "m_i a_i = -2 sum_j V_i V_j P* grad_i W_ij", "Zhang, Hu & Adams 2017, JCP 335, 605", \
      "At rest: the pressure of the contact is then the mean of the two. rates_riemann is the same sweep with motion.", \
      sph_fluid_rates_riemann(k, dim, a.cloud, a.pressure, a.riemann, a.rates)) \
    X(pressure_crk, sph_gas_rates_crk, PRESSURE, LARGER, \
      "m_i a_i = -1/2 sum_j V_i V_j (P_i + P_j + Q_ij) (grad W^R_ij - grad W^R_ji)", "Frontiere, Raskin & Owen 2017, JCP 332, 160", \
      "Keeps momentum and energy, not angular momentum. Needs sph_rk_correction first.", \
      sph_gas_rates_crk(k, dim, a.cloud, a.pressure, a.rk, a.corrected)) \
    X(pressure_iad, sph_gas_rates_iad, PRESSURE, LARGER, \
      "a_i = -sum_j m_j (P_i / rho_i^2 A_i + P_j / rho_j^2 A_j)", "Garcia-Senz, Cabezon & Escartin 2012, A&A 538, A9", \
      "Keeps momentum and energy, not angular momentum. Needs sph_gradient_correction_iad first.", \
      sph_gas_rates_iad(k, dim, a.cloud, a.pressure, a.iad, a.corrected)) \
    X(cleaning_gradient, sph_cleaning_rates, PRESSURE, LARGER, \
      "dB/dt = -grad psi", "Tricco & Price 2012", \
      "One half of the conjugate pair that cleans divergences; the other is cleaning_divergence.", \
      sph_cleaning_rates(k, dim, a.cloud, a.psi, a.rate_B)) \
    X(divergence_difference, sph_divergence_difference, DIVERGENCE, GATHER, \
      "div A_i = -(1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) . grad_i W_ij(h_i)", "Price 2012, JCP 231, 759", \
      "The rate of the density. 0 for constants; in disorder its error does not fall with the spacing.", \
      sph_divergence_difference(k, dim, a.cloud, a.medium, a.v, a.scalar)) \
    X(divergence_symmetric, sph_divergence_symmetric, DIVERGENCE, LARGER, \
      "div A_i = rho_i sum_j m_j (A_i g_i + A_j g_j) . x_ij", "Price 2012, JCP 231, 759", \
      "The conjugate of the difference form of the gradient. Measures the disorder as well.", \
      sph_divergence_symmetric(k, dim, a.cloud, a.medium, a.v, a.scalar)) \
    X(divergence_cspm, sph_velocity_gradient_cspm, DIVERGENCE, GATHER, \
      "grad f_i = K^-1 sum_j V_j (-F_ij) e (f_j - f_i)", "Cullen & Dehnen 2010", \
      "The divergence to look at; what belongs to a density that is summed up is divergence_difference.", \
      sph_velocity_gradient_cspm(k, dim, a.cloud, a.v, a.div_v)) \
    X(cleaning_divergence, sph_cleaning_rates, DIVERGENCE, LARGER, \
      "dpsi/dt = -ch^2 div B - sigma ch psi / h - psi div v / 2", "Tricco & Price 2012", \
      "The other half of the pair; see cleaning_gradient.", \
      sph_cleaning_rates(k, dim, a.cloud, a.field, a.div_B)) \
    X(curl_difference, sph_curl_difference, CURL, GATHER, \
      "curl A_i = (1 / (Omega_i rho_i)) sum_j m_j (A_i - A_j) x grad_i W_ij(h_i)", "Price 2012, (79)", \
      "In disorder its error does not fall with the spacing.", \
      sph_curl_difference(k, dim, a.cloud, a.medium, a.v, a.curl)) \
    X(laplacian_brookshaw, sph_laplacian_brookshaw, LAPLACIAN, GATHER, \
      "L f_i = sum_j 2 V_j (f_i - f_j) F_ij", "Brookshaw 1985, Proc. ASA 6, 207", \
      "Symmetric and of an M-matrix: it damps and never amplifies. In disorder its pointwise error grows; solutions of flows and heat are better than that.", \
      sph_laplacian_brookshaw(k, dim, a.cloud, a.f, a.scalar)) \
    X(laplacian_cspm, sph_derivatives_cspm, LAPLACIAN, GATHER, \
      "h^2 hess = M^-1 (sum w e e df - A h grad f)", "Chen, Beraun & Carney 1999, IJNME 46, 231", \
      "Kept because it is published: the others cost as much and are better.", \
      sph_derivatives_cspm(k, dim, a.cloud, a.f, a.second, a.laplacian)) \
    X(laplacian_icspm, sph_derivatives_icspm, LAPLACIAN, GATHER, \
      "df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...; g = -V_j F_ij and w = V_j W_ij / r^2", "Schilders & Anthonissen 2017, J. Appl. Math. Phys. 5, 168", \
      "Near a boundary single particles come near det(kappa) = 0: look at the conditioning, or ask for the fallback.", \
      sph_derivatives_icspm(k, dim, a.cloud, a.f, a.second, a.laplacian)) \
    X(laplacian_fatehi_manzari, sph_derivatives_fatehi_manzari, LAPLACIAN, GATHER, \
      "<lap f>_i = Bh : sum_j 2 V_j e grad W ((f_i - f_j) / r - e . <grad f>)", "Fatehi & Manzari 2011, Comput. Math. Appl. 61, 482", \
      "Keeps the signs of the weights in disorder; at a boundary single particles come near det(kappa) = 0.", \
      sph_derivatives_fatehi_manzari(k, dim, a.cloud, a.f, a.second, a.laplacian)) \
    X(laplacian_wls, sph_derivatives_wls, LAPLACIAN, GATHER, \
      "df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...; g = w = V_j W_ij", "weighted least-squares fit of a quadratic (moving least squares at the particle)", \
      "The most accurate, and not singular where there are enough neighbours.", \
      sph_derivatives_wls(k, dim, a.cloud, a.f, a.second, a.laplacian)) \
    X(wall_laplacian, sph_wall_laplacian, LAPLACIAN, GATHER, \
      "lap f = (sum_j 2 V_j (f_i - f_j) F_ij - 2 g_w . grad gamma) / gamma", "Macia et al. 2012, Prog. Theor. Phys. 128, 439", \
      "Walls without particles in them; all sides are walls here, and the slope of the field is given there. Compare it with laplacian_brookshaw.", \
      sph_wall_laplacian(k, dim, a.cloud, a.wall, a.f, a.scalar)) \
    X(hessian_cspm, sph_derivatives_cspm, HESSIAN, GATHER, \
      "h^2 hess = M^-1 (sum w e e df - A h grad f)", "Chen, Beraun & Carney 1999, IJNME 46, 231", \
      "Kept because it is published: the others cost as much and are better.", \
      sph_derivatives_cspm(k, dim, a.cloud, a.f, a.second, a.hessian)) \
    X(hessian_icspm, sph_derivatives_icspm, HESSIAN, GATHER, \
      "df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...; g = -V_j F_ij and w = V_j W_ij / r^2", "Schilders & Anthonissen 2017, J. Appl. Math. Phys. 5, 168", \
      "Near a boundary single particles come near det(kappa) = 0: look at the conditioning, or ask for the fallback.", \
      sph_derivatives_icspm(k, dim, a.cloud, a.f, a.second, a.hessian)) \
    X(hessian_fatehi_manzari, sph_derivatives_fatehi_manzari, HESSIAN, GATHER, \
      "df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...; g = -V_j F_ij and w = -V_j F_ij / r^2", "Fatehi & Manzari 2011, Comput. Math. Appl. 61, 482", \
      "At a boundary single particles come near det(kappa) = 0.", \
      sph_derivatives_fatehi_manzari(k, dim, a.cloud, a.f, a.second, a.hessian)) \
    X(hessian_wls, sph_derivatives_wls, HESSIAN, GATHER, \
      "df = e . (h grad f) + e_a e_b (h^2/2 d_a d_b f) + ...; g = w = V_j W_ij", "weighted least-squares fit of a quadratic (moving least squares at the particle)", \
      "The most accurate, and not singular where there are enough neighbours.", \
      sph_derivatives_wls(k, dim, a.cloud, a.f, a.second, a.hessian)) \
    X(elliptic_brookshaw, sph_elliptic_brookshaw, ELLIPTIC, MEAN, \
      "L u_i = sum_j T_ij (u_j - u_i); T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij); scale = 1", "(27), (51), (52), (69) for the four schemes", \
      "Symmetric, of an M-matrix, cheap; its pointwise error does not fall in disorder.", \
      sph_elliptic_brookshaw(k, dim, a.cloud, a.mobility, a.elliptic, a.f, a.scalar)) \
    X(elliptic_corrected, sph_elliptic_brookshaw_corrected, ELLIPTIC, MEAN, \
      "L u_i = sum_j T_ij (u_j - u_i); T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij); scale = tr K^-1 / dim", "(27), (51), (52), (69) for the four schemes", \
      "The scale of one matrix; what lattices have at boundaries is not mended.", \
      sph_elliptic_brookshaw_corrected(k, dim, a.cloud, a.mobility, a.elliptic, a.f, a.scalar)) \
    X(elliptic_schwaiger, sph_elliptic_schwaiger, ELLIPTIC, MEAN, \
      "L u_i = sum_j T_ij (u_j - u_i); T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij); scale = tr Gamma^-1 / dim; xi = K^-1 N", "Schwaiger 2008, IJNME 75, 647", \
      "Exact for linear fields anywhere. With the default gradient the numbers are those of elliptic_msph.", \
      sph_elliptic_schwaiger(k, dim, a.cloud, a.mobility, a.elliptic, a.f, a.scalar)) \
    X(elliptic_msph, sph_elliptic_msph, ELLIPTIC, MEAN, \
      "L u_i = sum_j T_ij (u_j - u_i); T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij); scale = tr Gamma^-1 / dim; xi = K^-1 N", "(27), (51), (52), (69) for the four schemes", \
      "Exact for linear fields anywhere. With options.gradient = SPH_GRADIENT_FULL it differs from elliptic_schwaiger.", \
      sph_elliptic_msph(k, dim, a.cloud, a.mobility, a.elliptic, a.f, a.scalar)) \
    X(elliptic_msph_trace, sph_elliptic_msph, ELLIPTIC, MEAN, \
      "L u_i = sum_j T_ij (u_j - u_i); T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij); factor is dim / tr Gamma", "This factor is an addition of this toolkit", \
      "options.trace = 1: exact for |x|^2 where it is available; at most boundary particles it is not.", \
      sph_elliptic_msph(k, dim, a.cloud, a.mobility, a.trace, a.f, a.scalar)) \
    X(elliptic_basic_degiuli_ban, sph_elliptic_basic_degiuli_ban, ELLIPTIC, MEAN, \
      "L u_i = sum_j T_ij (u_j - u_i); T_ij = scale_i V_j mu_ij (t_ij - xi_i . g_ij); scale = dim / tr Gamma", "Basic, Degiuli & Ban 2018, JCP 354, 269", \
      "Needs no derivative of the kernel. At one-sided particles it falls back.", \
      sph_elliptic_basic_degiuli_ban(k, dim, a.cloud, a.mobility, a.elliptic, a.f, a.scalar)) \
    X(elliptic_anisotropic, sph_elliptic_rows_anisotropic, ELLIPTIC, MEAN, \
      "row = V_j G sum_c S(M_i + M_j)_c (e_c^2 / |e|^2 - (K^-1 N_c) . e)", "This form is an addition of this toolkit", \
      "For a mobility of each axis; here all are the same. Comes as rows.", \
      atlas_anisotropic(k, dim, &a)) \
    X(elliptic_tensor, sph_elliptic_tensor, ELLIPTIC, MEAN, \
      "L u_i = sum_j V_j G sum_s S(M_i + M_j)_s (q_s / |e|^2 - (K^-1 N_s) . e) (u_j - u_i)", "An addition of this toolkit", \
      "For a full tensor; here a multiple of the unit matrix. Exact for quadratic fields anywhere.", \
      sph_elliptic_tensor(k, dim, a.cloud, a.tensor, a.f, a.scalar)) \
    X(viscosity_morris, sph_viscosity_mu_morris, VISCOSITY, MEAN, \
      "a_i = sum_j m_j B v_ij; B = (mu_i + mu_j) / (rho_i rho_j) F r^2 / (r^2 + eta^2 h^2)", "Morris, Fox & Zhu 1997, JCP 136, 214", \
      "Keeps momentum, damps. The same in all directions.", \
      sph_viscosity_mu_morris(k, dim, a.cloud, a.moving, a.one, a.vector)) \
    X(viscosity_monaghan_cleary, sph_viscosity_mu_monaghan_cleary, VISCOSITY, MEAN, \
      "a_i = sum_j m_j B x_ij", "Cleary & Monaghan 1999, JCP 148, 227", \
      "Keeps angular momentum, too. On a square lattice it depends on the direction: see the response to waves along axis and diagonal.", \
      sph_viscosity_mu_monaghan_cleary(k, dim, a.cloud, a.moving, a.one, a.vector)) \
    X(viscosity_espanol_revenga, sph_viscosity_mu_espanol_revenga, VISCOSITY, MEAN, \
      "a_i = sum_j m_j (along_v v_ij + along_x x_ij)", "Espanol & Revenga 2003", \
      "With a bulk viscosity, which is 0 here.", \
      sph_viscosity_mu_espanol_revenga(k, dim, a.cloud, a.moving, a.mu, a.vector)) \
    X(resistivity_ohmic, sph_resistivity_ohmic, VISCOSITY, LARGER, \
      "b = 2 eta m_j G / (rho_i rho_j)", "Physical (Ohmic) resistivity, (11)", \
      "Brookshaw's form for each component of a field without divergence.", \
      sph_resistivity_ohmic(k, dim, a.cloud, a.resistive, a.heated)) \
    X(density_adaptive, sph_density_adaptive, ADAPTIVE, GATHER, \
      "h_i = eta (m_i / rho_i)^(1/dim); rho_i = sum_j m_j W_ij(h_i)", "Price & Monaghan 2004", \
      "Half a density at a free surface, where h grows. Close particles take each other for a dense place: at the same h its error on random points is twice that of density_summation. Here the h of the tables is the longest that the lists allow; an even cloud has two thirds of it.", \
      atlas_adaptive(k, dim, &a)) \
    X(rates_monaghan, sph_fluid_rates_monaghan, RATES, MEAN, \
      "a_i = -sum_j m_j (P_ij + Pi_ij) grad_i W_ij", "Monaghan 1992, (3.3)", \
      "With artificial viscosity, alpha = 0.1, beta = 0. Its density rate loses nothing and smooths nothing.", \
      sph_fluid_rates_monaghan(k, dim, a.cloud, a.flow, a.lossy)) \
    X(rates_riemann, sph_fluid_rates_riemann, RATES, MEAN, \
      "m_i a_i = -2 sum_j V_i V_j P* grad_i W_ij; drho_i/dt = 2 rho_i sum_j V_j (v_i - v*) . grad_i W_ij", "Zhang, Hu & Adams 2017, JCP 335, 605", \
      "With the usual limiter, 3, without gravity. It smooths jumps of pressure, and leaves a contact alone.", \
      sph_fluid_rates_riemann(k, dim, a.cloud, a.flow, a.riemann, a.lossy)) \
    X(shift_displacement, sph_shift_displacement, SHIFTING, MEAN, \
      "dx_i = -strength_i G_i", "Lind, Xu, Stansby & Rogers 2012, JCP 231, 1499", \
      "Strength 0.4 h^2, without a limit. Without the directions of a free surface it throws particles out there.", \
      sph_shift_displacement(k, dim, a.cloud, a.shift, a.vector)) \
    X(shift_tensile, sph_shift_displacement, SHIFTING, MEAN, \
      "G_i = sum_j V_j (1 + R (W_ij / W(dx))^4) grad_i W_ij", "Sun, Colagrossi, Marrone & Zhang 2017, CMAME 315, 25", \
      "R = 0.2: pushes close particles a little more apart. Strength 0.4 h^2, without a limit.", \
      sph_shift_displacement(k, dim, a.cloud, a.tensile, a.vector)) \
    X(collision_sequential, sph_collision_sequential, COLLISIONS, CLOSE, \
      "dv_i = -(1 + C_R) w_i / (w_i + w_j) (v_ij . e) e", "Korzilius, Schilders & Anthonissen, section IV", \
      "One pair after the other; not for ranges of threads. Here the distance is 0.75 dx, C_R = 1/2, and lists are those of the kernel: its own are far shorter, and then it costs less.", \
      atlas_sequential(dim, &a)) \
    X(collision_weighted, sph_collision_change_weighted, COLLISIONS, CLOSE, \
      "dv_i = -(1 + C_R) w_i / (w_i + w_j) (v_ij . e) e", "Korzilius, Schilders & Anthonissen, section IV", \
      "All pairs at once, in any order and on any number of threads; particles in several collisions lose more energy and stay closer. Distance and lists as in collision_sequential.", \
      atlas_weighted(dim, &a)) \
    X(gravity_direct, sph_gravity_direct, GRAVITY, NONE, \
      "E = G/2 sum_i sum_j m_i m_j (phi(r, h_i) + phi(r, h_j)) / 2", "Price & Monaghan 2007, MNRAS 374, 1347", \
      "In 3D only. n^2 steps: its cost for a particle is that among 8000 of them. If h follows the density, sph_gravity_correction belongs to it.", \
      dim == 3 ? sph_gravity_direct(k, a.cloud, a.m_f, SPH_R(1), a.vector, a.potential) : (sph_index)SPH_OK)
/* clang-format on */

#endif
