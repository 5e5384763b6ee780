/* SPDX-License-Identifier: MIT */
/*
 * test_calls.c - what all calls have in common, beyond the answers to bad input that CONTRACT.md has: marks
 * of clouds, what SPH_REFUSED is told, options that are left at 0, and the status of sums that overflow.
 */
#include "one_copy.h"
#include "refusal.h"
#include "../sph.h"

#include "check.h"
#include "clouds.h"

#include <float.h>
#include <string.h>

static const sph_kernel KERNEL = SPH_WENDLAND_C2;
static const double LIMIT = SPH_SINGLE ? (double)FLT_MAX : DBL_MAX;
static const sph_index ODD = 17; /* the particle that is at fault */

/* ---- a cloud with fields, and outputs ---- */

enum { H, M, RHO, P, C, F, G, VX, VY, VZ, BX, BY, BZ, ONE, FIELDS };
enum { OUTPUTS = 11 };
typedef struct setup {
    cloud c;
    sph_real *a[FIELDS], *out[OUTPUTS];
    unsigned char *status;
} setup;

static setup setup_new(int dim)
{
    static const int side[] = {0, 40, 8, 5};
    setup s;
    pcg32 g;
    sph_index i;
    int k;
    s.c = cloud_lattice(dim, side[dim], 1.3, 0.2, 3);
    cloud_set(&s.c, field_smooth);
    pcg32_seed(&g, 8, (uint64_t)dim);
    for (k = 0; k < FIELDS; k++) s.a[k] = (sph_real *)cloud_memory((size_t)s.c.n, sizeof(sph_real));
    for (k = 0; k < OUTPUTS; k++) s.out[k] = (sph_real *)cloud_memory((size_t)s.c.n, sizeof(sph_real));
    s.status = (unsigned char *)cloud_memory((size_t)s.c.n, 1);
    for (i = 0; i < s.c.n; i++) {
        for (k = 0; k < FIELDS; k++) s.a[k][i] = SPH_R(k == ONE ? 1.0 : 0.5 + pcg32_uniform(&g));
        for (k = VX; k < ONE; k++) s.a[k][i] = SPH_R(cloud_symmetric(&g));
        s.a[H][i] = s.c.h;
        s.a[M][i] = s.c.V[i];
        s.a[F][i] = s.c.f[i];
    }
    return s;
}
static void setup_free(setup *s)
{
    int k;
    cloud_free(&s->c);
    for (k = 0; k < FIELDS; k++) free(s->a[k]);
    for (k = 0; k < OUTPUTS; k++) free(s->out[k]);
    free(s->status);
}
static sph_scalars at(const setup *s, int field) { return sph_scalars_array(s->a[field]); }
static sph_vectors three(const setup *s, int field)
{
    return sph_vectors_separate(s->a[field], s->a[field + 1], s->c.dim > 2 ? s->a[field + 2] : 0);
}
static sph_cloud cloud_of(const setup *s)
{
    return sph_cloud_of(cloud_points(&s->c), cloud_list(&s->c), at(s, H), cloud_V(&s->c));
}
static sph_scalar_out scalar_out(const setup *s) { return sph_scalar_out_array(s->out[0], s->status); }
static sph_vector_out vector_out(const setup *s, int k)
{
    return sph_vector_out_separate(s->out[k], s->out[k + 1], s->out[k + 2]);
}
static sph_fluid fluid_of(const setup *s)
{
    sph_fluid f = {0};
    f.m = at(s, M);
    f.rho = at(s, RHO);
    f.p = at(s, P);
    f.c = at(s, C);
    f.v = three(s, VX);
    return f;
}
static sph_fluid_out fluid_out(const setup *s)
{
    sph_fluid_out o = {0};
    o.acceleration = vector_out(s, 0);
    o.rate = s->out[3];
    o.heating = s->out[4];
    o.status = s->status;
    return o;
}
static sph_medium medium_of(const setup *s)
{
    sph_medium g;
    g.m = at(s, M);
    g.rho = at(s, RHO);
    g.omega = at(s, ONE);
    return g;
}
static sph_index mhd(const setup *s)
{
    sph_mhd state = {0};
    sph_mhd_out o = {0};
    state.medium = medium_of(s);
    state.p = at(s, P);
    state.u = state.cs = at(s, C);
    state.alpha = state.alpha_B = at(s, ONE);
    state.v = three(s, VX);
    state.field = three(s, BX);
    o.acceleration = vector_out(s, 0);
    o.rate_B = vector_out(s, 3);
    o.rate_u = s->out[6];
    o.v_sig = s->out[7];
    o.status = s->status;
    return sph_mhd_rates(KERNEL, s->c.dim, cloud_of(s), state, o);
}
static sph_index cleaning(const setup *s, sph_scalars div_v)
{
    sph_cleaning state = {0};
    sph_cleaning_out o = {0};
    state.medium = medium_of(s);
    state.field = three(s, BX);
    state.psi = at(s, F);
    state.div_v = div_v;
    state.ch = SPH_R(1);
    o.rate_B = vector_out(s, 0);
    o.rate_psi = s->out[3];
    o.status = s->status;
    return sph_cleaning_rates(KERNEL, s->c.dim, cloud_of(s), state, o);
}

/* ---- marks ---- */

static sph_index shepard(const setup *s, sph_cloud given)
{
    refusal.count = 0;
    return sph_shepard_sum(KERNEL, s->c.dim, given, scalar_out(s));
}
/* the mark of a cloud with a fault, and what any sweep answers then, also on a part of the cloud */
static void check_mark(const char *fault, const setup *s, int dim, sph_cloud given, int error)
{
    sph_cloud marked;
    sph_index whole, part;
    refusal.count = 0;
    marked = sph_cloud_checked(dim, given);
    whole = sph_shepard_sum(KERNEL, dim, marked, scalar_out(s));
    part = sph_shepard_sum(KERNEL, dim, sph_cloud_range(marked, 3, 5), scalar_out(s));
    if (!check_count(marked.checked == error && whole == error && part == error))
        fprintf(stderr,
                "test_calls.c: failed: %s in %dD: marked %d, answered %ld and for a range %ld, expected %d\n",
                fault, s->c.dim, marked.checked, (long)whole, (long)part, error);
    if (dim < 1 || dim > 3) return; /* every sweep looks at the dimension itself */
    if (!check_count(refusal.count == 1 && refusal.error == error))
        fprintf(
            stderr,
            "test_calls.c: failed: %s in %dD: SPH_REFUSED %d times, last with %d, expected once with %d\n",
            fault, s->c.dim, refusal.count, refusal.error, error);
}
static void test_marks_of_faults(setup *s)
{
    const int dim = s->c.dim;
    const sph_cloud good = cloud_of(s);
    const sph_index p = s->c.start[ODD], entry = s->c.index[p];
    const sph_real x = s->c.x[ODD], V = s->c.V[ODD], h = s->a[H][ODD];
    sph_cloud c = good;
    check_mark("dimension 0", s, 0, good, SPH_ERROR_DIM);
    s->c.x[ODD] = SPH_R(NAN);
    check_mark("position NaN", s, dim, good, SPH_ERROR_POSITION);
    s->c.x[ODD] = x;
    s->c.V[ODD] = SPH_R(NAN);
    check_mark("volume NaN", s, dim, good, SPH_ERROR_VALUE);
    s->c.V[ODD] = V;
    s->a[H][ODD] = SPH_R(0);
    check_mark("h 0", s, dim, good, SPH_ERROR_H);
    s->a[H][ODD] = h;
    s->c.index[p] = s->c.n;
    check_mark("a neighbour that there is not", s, dim, good, SPH_ERROR_LIST);
    s->c.index[p] = ODD;
    check_mark("a particle in its own list", s, dim, good, SPH_ERROR_SELF);
    s->c.index[p] = entry;
    c.points.box.x = SPH_R(-1);
    check_mark("a length below 0", s, dim, c, SPH_ERROR_BOX);
    c = good;
    c.points.n = -1;
    check_mark("a negative number of particles", s, dim, c, SPH_ERROR_COUNT);
    c = good;
    c.last = s->c.n + 1;
    check_mark("more targets than particles", s, dim, c, SPH_ERROR_RANGE);
    c = good;
    c.list.start = 0; /* which gravity of all pairs and sums do not need */
    c = sph_cloud_checked(dim, c);
    CHECK(c.checked == 1);
    refusal.count = 0;
    CHECK(shepard(s, c) == SPH_ERROR_NULL && refusal.count == 1);
    /* how far sums reach depends on their kernel: a box that is too small is found by the sweep */
    c = good;
    c.points.box.x = SPH_R(3) * s->c.h;
    c = sph_cloud_checked(dim, c);
    CHECK(c.checked == 1);
    CHECK(shepard(s, c) == SPH_ERROR_BOX && refusal.count == 1);
}
static void test_marks_and_ranges(setup *s)
{
    const sph_index n = s->c.n, last = n - 3;
    const int dim = s->c.dim;
    const sph_index p = s->c.start[0], entry = s->c.index[p];
    sph_cloud c;
    s->c.index[p] = n; /* the row of a particle that is no target */
    c = sph_cloud_checked(dim, sph_cloud_range(cloud_of(s), 3, last));
    CHECK(c.checked == 1);
    CHECK(sph_cloud_range(c, 3, last).checked == 1);
    CHECK(sph_cloud_range(c, 4, last - 1).checked == 1);
    CHECK(sph_cloud_range(c, 2, last).checked == 0);
    CHECK(sph_cloud_range(c, 3, last + 1).checked == 0);
    CHECK(sph_cloud_range(sph_cloud_range(c, 4, 5), 3, 5).checked == 0);
    CHECK(shepard(s, c) == 0 && refusal.count == 0);
    CHECK(shepard(s, sph_cloud_range(c, 4, last - 1)) == 0 && refusal.count == 0);
    CHECK(shepard(s, sph_cloud_range(c, 0, last)) == SPH_ERROR_LIST && refusal.count == 1 &&
          refusal.particle == 0);
    CHECK(shepard(s, sph_cloud_range(c, 5, 4)) == SPH_ERROR_RANGE && refusal.count == 1);
    s->c.index[p] = entry;
    c = sph_cloud_checked(dim, sph_cloud_range(cloud_of(s), 3, 3)); /* nothing was looked at */
    s->c.index[s->c.start[3]] = n;
    CHECK(shepard(s, c) == 0);
    CHECK(shepard(s, sph_cloud_range(c, 3, 4)) == SPH_ERROR_LIST);
    s->c.index[s->c.start[3]] = s->c.index[s->c.start[3] + 1];
}
/* A scan sees every entry of a row. What is outside is told before what is in its own list. */
static void test_entries(setup *s)
{
    const sph_index n = s->c.n, rows[3] = {0, ODD, n - 1};
    sph_index *const first = &s->c.index[s->c.start[0]], first_entry = *first, p;
    int r, f;
    for (r = 0; r < 3; r++)
        for (p = s->c.start[rows[r]]; p < s->c.start[rows[r] + 1]; p++) {
            const sph_index i = rows[r], entry = s->c.index[p], fault[3] = {-1, n, i};
            for (f = 0; f < 3; f++) {
                const int error = f < 2 ? SPH_ERROR_LIST : SPH_ERROR_SELF;
                s->c.index[p] = fault[f];
                CHECK_AT("fault of an entry", p,
                         shepard(s, cloud_of(s)) == error && refusal.count == 1 && refusal.particle == i);
                if (f == 2 || &s->c.index[p] == first) continue;
                *first = 0;
                CHECK_AT("two faults", p, shepard(s, cloud_of(s)) == error && refusal.particle == i);
                *first = first_entry;
            }
            s->c.index[p] = entry;
        }
}
/* What is marked is not looked at again (with what is wrong, but does no harm), and what comes with it is. */
static void test_marks_save_scans(setup *s)
{
    const int dim = s->c.dim;
    const sph_index p = s->c.start[ODD], entry = s->c.index[p];
    const sph_real V = s->c.V[ODD], m = s->a[M][ODD];
    const sph_cloud c = sph_cloud_checked(dim, cloud_of(s));
    sph_cloud same = cloud_of(s);
    s->c.index[p] = ODD;
    CHECK(shepard(s, cloud_of(s)) == SPH_ERROR_SELF);
    CHECK(shepard(s, c) == 0 && refusal.count == 0);
    s->c.index[p] = entry;
    s->c.V[ODD] = SPH_R(NAN);
    CHECK(shepard(s, cloud_of(s)) == SPH_ERROR_VALUE);
    CHECK(shepard(s, c) > 0 && refusal.count == 0 && s->status[ODD] == SPH_NOT_FINITE);
    s->c.V[ODD] = V;
    s->a[M][ODD] = SPH_R(NAN);
    refusal.count = 0;
    CHECK(sph_density_summation(KERNEL, dim, c, at(s, M), scalar_out(s)) == SPH_ERROR_VALUE);
    CHECK(refusal.count == 1 && refusal.particle == ODD && strcmp(refusal.argument, "m") == 0);
    same.volume = sph_scalars_same(s->a[M]); /* where the masses begin: one of them was looked at */
    same = sph_cloud_checked(dim, same);
    CHECK(same.checked == 1);
    CHECK(sph_density_summation(KERNEL, dim, same, at(s, M), scalar_out(s)) == SPH_ERROR_VALUE);
    s->a[M][ODD] = m;
}

/* ---- what SPH_REFUSED is told: three examples; test_contract.c has all ---- */

static void check_refusal(const char *argument, long particle, int error, sph_index answer)
{
    if (!check_count(answer == error && refusal.count == 1 && refusal.error == error &&
                     refusal.particle == particle && strcmp(refusal.argument, argument) == 0))
        fprintf(stderr,
                "test_calls.c: failed: answered %ld, SPH_REFUSED %d times: %s at particle %ld, error %d; "
                "expected %s at %ld, error %d\n",
                (long)answer, refusal.count, refusal.count ? refusal.argument : "", refusal.particle,
                refusal.error, argument, particle, error);
    refusal.count = 0;
}
static void test_refusals(setup *s)
{
    const int dim = s->c.dim;
    const sph_cloud all = cloud_of(s), part = sph_cloud_range(all, ODD + 1, s->c.n);
    sph_fluid f = fluid_of(s);
    const sph_real rho = s->a[RHO][ODD];
    refusal.count = 0;
    s->a[RHO][ODD] = SPH_R(0); /* of a source that is no target */
    check_refusal("rho", ODD, SPH_ERROR_VALUE, sph_fluid_rates_monaghan(KERNEL, dim, part, f, fluid_out(s)));
    s->a[RHO][ODD] = rho;
    f.c = sph_scalars_none(); /* not read without artificial viscosity */
    CHECK(sph_fluid_rates_monaghan(KERNEL, dim, all, f, fluid_out(s)) == 0 && refusal.count == 0);
    f.viscosity = SPH_VISCOSITY_LINEAR;
    check_refusal("c", -1, SPH_ERROR_NULL, sph_fluid_rates_monaghan(KERNEL, dim, all, f, fluid_out(s)));
    f.viscosity = -1;
    check_refusal("fluid.viscosity", -1, SPH_ERROR_VALUE,
                  sph_fluid_rates_monaghan(KERNEL, dim, all, f, fluid_out(s)));
}

/* ---- options that are left at 0 ---- */

static void clear(const setup *s)
{
    int k;
    for (k = 0; k < OUTPUTS; k++) memset(s->out[k], 0, (size_t)s->c.n * sizeof(sph_real));
}
static void keep(const setup *s, sph_real *copy)
{
    int k;
    for (k = 0; k < OUTPUTS; k++) memcpy(copy + k * s->c.n, s->out[k], (size_t)s->c.n * sizeof *copy);
    clear(s);
}
static int kept(const setup *s, const sph_real *copy)
{
    int k, same = 1;
    for (k = 0; k < OUTPUTS; k++)
        same &= memcmp(copy + k * s->c.n, s->out[k], (size_t)s->c.n * sizeof *copy) == 0;
    return same;
}
/* the viscous heating of a target by pairs, which softens by what it is told */
static double heating(const setup *s, const sph_fluid *f, sph_index i, sph_real eta)
{
    const sph_points x = cloud_points(&s->c);
    const int dim = s->c.dim;
    sph_viscosity_terms terms;
    double sum = 0.0;
    sph_index p;
    terms.alpha = f->alpha;
    terms.beta = f->beta;
    terms.eta = eta;
    for (p = s->c.start[i]; p < s->c.start[i + 1]; p++) {
        const sph_index j = s->c.index[p];
        const sph_vec x_ij = sph_subtract(dim, sphi_point(dim, x, i), sphi_point(dim, x, j));
        sph_encounter e;
        e.r = sph_length(dim, x_ij);
        e.vx =
            sph_dot(dim, sph_subtract(dim, sphi_vector_at(dim, f->v, i), sphi_vector_at(dim, f->v, j)), x_ij);
        e.h = s->c.h;
        e.c = SPH_R(0.5) * (s->a[C][i] + s->a[C][j]);
        e.rho = SPH_R(0.5) * (s->a[RHO][i] + s->a[RHO][j]);
        sum += 0.5 * (double)(s->a[M][j] * sph_viscosity_pair_monaghan(terms, e) * e.vx *
                              sph_kernel_f(KERNEL, dim, e.r, e.h));
    }
    return sum;
}
static void test_default_softening(setup *s, sph_real *copy)
{
    const int dim = s->c.dim;
    const sph_cloud all = cloud_of(s);
    sph_fluid f = fluid_of(s);
    int form;
    f.viscosity = SPH_VISCOSITY_MONAGHAN;
    f.alpha = f.beta = SPH_R(1);
    CHECK(sph_fluid_rates_monaghan(KERNEL, dim, all, f, fluid_out(s)) == 0);
    CHECK_RELATIVE((double)s->out[4][ODD], heating(s, &f, ODD, SPH_R(0.1)), 1e3 * (double)SPH_EPSILON);
    keep(s, copy);
    f.eta = SPH_R(0.1);
    CHECK(sph_fluid_rates_monaghan(KERNEL, dim, all, f, fluid_out(s)) == 0);
    CHECK(kept(s, copy));
    f.eta = SPH_R(-3);
    CHECK(sph_fluid_rates_monaghan(KERNEL, dim, all, f, fluid_out(s)) == 0);
    CHECK_RELATIVE((double)s->out[4][ODD], heating(s, &f, ODD, SPH_R(0)), 1e3 * (double)SPH_EPSILON);
    CHECK(!kept(s, copy));
    for (form = 0; form < 2; form++) {
        clear(s);
        sph_index (*const viscosity)(sph_kernel, int, sph_cloud, sph_fluid, sph_scalars, sph_vector_out) =
            form ? sph_viscosity_mu_morris : sph_viscosity_mu_monaghan_cleary;
        f.eta = SPH_R(0);
        CHECK(viscosity(KERNEL, dim, all, f, at(s, ONE), vector_out(s, 0)) == 0);
        keep(s, copy);
        f.eta = SPH_R(0.1);
        CHECK(viscosity(KERNEL, dim, all, f, at(s, ONE), vector_out(s, 0)) == 0);
        CHECK(kept(s, copy));
        f.eta = SPH_R(-1);
        CHECK(viscosity(KERNEL, dim, all, f, at(s, ONE), vector_out(s, 0)) == 0);
        CHECK(!kept(s, copy));
        keep(s, copy);
        f.eta = SPH_R(-0.2);
        CHECK(viscosity(KERNEL, dim, all, f, at(s, ONE), vector_out(s, 0)) == 0);
        CHECK(kept(s, copy));
        f.eta = SPH_R(1e-9); /* next to none */
        CHECK(viscosity(KERNEL, dim, all, f, at(s, ONE), vector_out(s, 0)) == 0);
        CHECK_RELATIVE((double)s->out[0][ODD], (double)copy[ODD], 1e3 * (double)SPH_EPSILON);
    }
}
static void adapt(const setup *s, sph_density_options d)
{
    const sph_density_out o = {.h = s->out[0], .rho = s->out[1], .omega = s->out[2], .status = s->status};
    const sph_real radius = SPH_R(2.05) * s->c.h;
    memcpy(s->out[0], s->a[H], (size_t)s->c.n * sizeof(sph_real));
    d.list_radius = sph_scalars_same(&radius);
    CHECK(sph_density_adaptive(KERNEL, s->c.dim, cloud_of(s), at(s, M), d, o) >= 0);
}
static void test_default_density(setup *s, sph_real *copy)
{
    sph_density_options d = {0};
    clear(s);
    adapt(s, d);
    keep(s, copy);
    d.eta = sph_kernel_h_over_dx(KERNEL);
    d.tolerance = SPH_R(1e-3);
    adapt(s, d);
    CHECK(kept(s, copy));
    d.tolerance = SPH_R(1e-6);
    adapt(s, d);
    CHECK(!kept(s, copy));
    d.tolerance = SPH_R(1e-3);
    d.eta = SPH_R(0.9) * sph_kernel_h_over_dx(KERNEL);
    adapt(s, d);
    CHECK(!kept(s, copy));
}
static void test_default_elliptic(setup *s, sph_real *copy)
{
    const int dim = s->c.dim;
    const sph_cloud all = cloud_of(s);
    sph_elliptic_options o = {0};
    sph_real largest = SPH_R(0);
    sph_index i;
    clear(s);
    CHECK(sph_elliptic_schwaiger(KERNEL, dim, all, at(s, C), o, at(s, F), scalar_out(s)) == 0);
    keep(s, copy);
    o.gradient = SPH_GRADIENT_DIFFUSE;
    o.mean = SPH_MOBILITY_ARITHMETIC;
    o.potential = at(s, P); /* for another mean */
    CHECK(sph_elliptic_schwaiger(KERNEL, dim, all, at(s, C), o, at(s, F), scalar_out(s)) == 0);
    CHECK(kept(s, copy));
    /* arithmetic means, no source: the sum over pairs of V_j (m_i + m_j) (u_i - u_j) F_ij */
    CHECK(sph_elliptic_brookshaw(KERNEL, dim, all, at(s, C), (sph_elliptic_options){0}, at(s, F),
                                 scalar_out(s)) == 0);
    for (i = 0; i < s->c.n; i++)
        if (SPHI_ABS(s->out[0][i]) > largest) largest = SPHI_ABS(s->out[0][i]);
    for (i = 0; i < s->c.n; i++) {
        double sum = 0.0;
        sph_index p;
        for (p = s->c.start[i]; p < s->c.start[i + 1]; p++) {
            const sph_index j = s->c.index[p];
            const sph_real r = sph_length(
                dim, sph_subtract(dim, sphi_point(dim, all.points, i), sphi_point(dim, all.points, j)));
            sum += (double)(s->c.V[j] * (s->a[C][i] + s->a[C][j]) * (s->a[F][i] - s->a[F][j]) *
                            sph_kernel_f(KERNEL, dim, r, s->c.h));
        }
        CHECK_NEAR("elliptic operator with default options", i, s->out[0][i], sum,
                   100.0 * (double)SPH_EPSILON * (double)largest);
    }
}
static void test_default_derivatives(setup *s, sph_real *copy)
{
    const sph_derivatives_out out = cloud_derivatives_out(s->out, s->status);
    const sph_cloud all = cloud_of(s);
    const int dim = s->c.dim;
    sph_derivatives_options o = {0};
    sph_index i, none, other = 0;
    /* what lacks neighbours at a corner has no derivatives; all else has, however badly conditioned */
    clear(s);
    none = sph_derivatives_icspm(KERNEL, dim, all, at(s, F), o, out);
    CHECK(none >= 0 && none < s->c.n / 4);
    for (i = 0; i < s->c.n; i++)
        other += s->status[i] == SPH_ILL_CONDITIONED || s->status[i] == SPH_FELL_BACK;
    CHECK(other == 0);
    keep(s, copy);
    o.conditioning_min = SPH_R(100); /* above any */
    CHECK(sph_derivatives_icspm(KERNEL, dim, all, at(s, F), o, out) == s->c.n);
    CHECK(kept(s, copy));
    CHECK(s->status[s->c.n / 2] == SPH_ILL_CONDITIONED);
    o.fallback_wls = 1;
    CHECK(sph_derivatives_icspm(KERNEL, dim, all, at(s, F), o, out) == s->c.n);
    CHECK(!kept(s, copy));
    CHECK(s->status[s->c.n / 2] == SPH_FELL_BACK);
}
static void test_default_states(setup *s, sph_real *copy)
{
    const sph_real zero = SPH_R(0);
    clear(s);
    CHECK(cleaning(s, sph_scalars_none()) == 0);
    keep(s, copy);
    CHECK(cleaning(s, sph_scalars_same(&zero)) == 0);
    CHECK(kept(s, copy));
    CHECK(cleaning(s, at(s, ONE)) == 0);
    CHECK(!kept(s, copy));
    CHECK((int)SPH_VISCOSITY_NONE == 0 && (int)SPH_GRADIENT_DIFFUSE == 0 &&
          (int)SPH_MOBILITY_ARITHMETIC == 0);
}

/* ---- sums that overflow ---- */

static sph_index call_shepard(const setup *s)
{
    return sph_shepard_sum(KERNEL, s->c.dim, cloud_of(s), scalar_out(s));
}
static sph_index call_density(const setup *s)
{
    return sph_density_summation(KERNEL, s->c.dim, cloud_of(s), at(s, M), scalar_out(s));
}
static sph_index call_number(const setup *s)
{
    return sph_density_number(KERNEL, s->c.dim, cloud_of(s), at(s, M), scalar_out(s));
}
static sph_index call_laplacian(const setup *s)
{
    return sph_laplacian_brookshaw(KERNEL, s->c.dim, cloud_of(s), at(s, F), scalar_out(s));
}
static sph_index call_elliptic(const setup *s)
{
    return sph_elliptic_brookshaw(KERNEL, s->c.dim, cloud_of(s), at(s, ONE), (sph_elliptic_options){0},
                                  at(s, F), scalar_out(s));
}
static sph_index call_divergence(const setup *s)
{
    return sph_divergence_difference(KERNEL, s->c.dim, cloud_of(s), medium_of(s), three(s, BX),
                                     scalar_out(s));
}
static sph_index call_symmetric(const setup *s)
{
    return sph_divergence_symmetric(KERNEL, s->c.dim, cloud_of(s), medium_of(s), three(s, BX), scalar_out(s));
}
static sph_index call_monaghan(const setup *s)
{
    return sph_fluid_rates_monaghan(KERNEL, s->c.dim, cloud_of(s), fluid_of(s), fluid_out(s));
}
static sph_index call_colagrossi(const setup *s)
{
    return sph_fluid_rates_colagrossi(KERNEL, s->c.dim, cloud_of(s), fluid_of(s), fluid_out(s));
}
static sph_index call_hu_adams(const setup *s)
{
    return sph_fluid_rates_hu_adams(KERNEL, s->c.dim, cloud_of(s), fluid_of(s), fluid_out(s));
}
static sph_index call_riemann(const setup *s)
{
    return sph_fluid_rates_riemann(KERNEL, s->c.dim, cloud_of(s), fluid_of(s), (sph_riemann_options){0},
                                   fluid_out(s));
}
static sph_index call_cleaning(const setup *s) { return cleaning(s, sph_scalars_none()); }

/* What overflows is 0, says so, and is counted; nothing else is. `field` is as large as numbers can be at one
   particle (-1: its volume), and, where it may have any sign, as much below 0 at a neighbour of it. */
static void test_overflow(setup *s)
{
    static const struct {
        const char *name;
        sph_index (*call)(const setup *);
        int field, outputs; /* bits of the outputs: a scalar or the first component of a vector, and others */
    } cases[] = {{"shepard_sum", call_shepard, -1, 1},
                 {"density_summation", call_density, M, 1},
                 {"density_number", call_number, M, 1},
                 {"laplacian_brookshaw", call_laplacian, F, 1},
                 {"elliptic_brookshaw", call_elliptic, F, 1},
                 {"divergence_difference", call_divergence, BX, 1},
                 {"divergence_symmetric", call_symmetric, BX, 1},
                 {"fluid_rates_monaghan", call_monaghan, P, 1 | 8},
                 {"fluid_rates_colagrossi", call_colagrossi, P, 1 | 8},
                 {"fluid_rates_hu_adams", call_hu_adams, P, 1 | 8},
                 {"fluid_rates_riemann", call_riemann, P, 1 | 8},
                 {"mhd_rates", mhd, P, 1 | 8 | 64 | 128},
                 {"cleaning_rates", call_cleaning, F, 1 | 8}};
    size_t k;
    for (k = 0; k < sizeof cases / sizeof *cases; k++) {
        sph_real *const a = cases[k].field < 0 ? s->c.V : s->a[cases[k].field];
        const sph_index by = s->c.index[s->c.start[ODD]];
        const sph_real good = a[ODD], good_by = a[by];
        sph_index answer, i, failed = 0;
        int c;
        clear(s);
        memset(s->status, 0xAB, (size_t)s->c.n);
        a[ODD] = SPH_R(LIMIT);
        if (cases[k].field >= F) a[by] = SPH_R(-LIMIT);
        answer = cases[k].call(s);
        a[ODD] = good;
        a[by] = good_by;
        for (i = 0; i < s->c.n; i++) {
            int lost = 0;
            for (c = 0; c < OUTPUTS; c++) lost |= (cases[k].outputs >> c & 1) && s->out[c][i] == SPH_R(0);
            failed += lost;
            if (!check_count(s->status[i] == (lost ? SPH_NOT_FINITE : SPH_OK)))
                fprintf(stderr,
                        "test_calls.c: failed: sph_%s in %dD: status %d of particle %ld, whose sum %s\n",
                        cases[k].name, s->c.dim, (int)s->status[i], (long)i, lost ? "overflowed" : "did not");
        }
        if (!check_count(answer == failed && failed > 0 && failed < s->c.n))
            fprintf(stderr,
                    "test_calls.c: failed: sph_%s in %dD answered %ld, but %ld of %ld sums overflowed\n",
                    cases[k].name, s->c.dim, (long)answer, (long)failed, (long)s->c.n);
    }
}

int main(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        setup s = setup_new(dim);
        sph_real *const copy = (sph_real *)cloud_memory((size_t)s.c.n * OUTPUTS, sizeof *copy);
        test_marks_of_faults(&s);
        test_marks_and_ranges(&s);
        test_marks_save_scans(&s);
        test_entries(&s);
        test_refusals(&s);
        test_default_softening(&s, copy);
        test_default_density(&s, copy);
        test_default_elliptic(&s, copy);
        test_default_derivatives(&s, copy);
        test_default_states(&s, copy);
        test_overflow(&s);
        free(copy);
        setup_free(&s);
    }
    return check_report("test_calls");
}
