/* SPDX-License-Identifier: MIT */
/*
 * test_gas.c - gas without a field: equal to magnetised gas with B = 0, what is conserved at one instant on random states, which conductivity is silent in an atmosphere at rest, gradients of
 * the velocity, the switches of viscosity, and physical resistivity with its heat and its time step.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#define KERNEL SPH_CUBIC_SPLINE
#define EPSILON ((double)SPH_EPSILON)

enum { M, RHO, OMEGA, H, P, U, CS, ALPHA, ZERO, VX, VY, VZ, BX, BY, BZ, ETA, AX, AY, AZ, CX, CY, CZ, RU, RV, DIV, DIV2, VSIG, VSIG2, CURL, SHEAR, SQUARE, RATIO, ARRAYS };
typedef struct state {
    cloud c;
    sph_real *a[ARRAYS];
} state;

static sph_scalars field(const state *s, int which) { return sph_scalars_array(s->a[which]); }
static sph_vectors three(const state *s, int first, int parts)
{
    return sph_vectors_separate(s->a[first], parts > 1 ? s->a[first + 1] : 0, parts > 2 ? s->a[first + 2] : 0);
}
static sph_vector_out three_out(const state *s, int first) { return sph_vector_out_separate(s->a[first], s->a[first + 1], s->a[first + 2]); }
static sph_medium medium(const state *s)
{
    sph_medium m;
    m.m = field(s, M);
    m.rho = field(s, RHO);
    m.omega = field(s, OMEGA);
    return m;
}
static sph_cloud view(const state *s) { return sph_cloud_of(cloud_points(&s->c), cloud_list(&s->c), field(s, H), cloud_V(&s->c)); }
static sph_gas gas(const state *s, int conductivity)
{
    sph_gas g;
    g.medium = medium(s);
    g.p = field(s, P);
    g.u = field(s, U);
    g.cs = field(s, CS);
    g.alpha = field(s, ALPHA);
    g.v = three(s, VX, s->c.dim);
    g.beta = SPH_R(2);
    g.alpha_u = SPH_R(0.8);
    g.conductivity = conductivity;
    return g;
}
static void rates(const state *s, sph_gas g)
{
    sph_gas_out o = {0};
    o.acceleration = three_out(s, AX);
    o.rate_u = s->a[RU];
    o.div_v = s->a[DIV];
    o.v_sig = s->a[VSIG];
    CHECK(sph_gas_rates(KERNEL, s->c.dim, view(s), g, o) == 0);
}

static void lists(state *s)
{
    sph_real *const R = (sph_real *)cloud_memory((size_t)s->c.n, sizeof *R);
    sph_index i;
    for (i = 0; i < s->c.n; i++) R[i] = SPH_R(2) * s->a[H][i];
    CHECK(cloud_search(&s->c, SPH_LARGER, sph_scalars_array(R)) == 0);
    free(R);
}
/* random in everything but what must be positive; h and Omega of each particle's own, or one h */
static state random_state(int dim, int own)
{
    static const int side[] = {0, 41, 17, 9};
    state s;
    pcg32 g;
    sph_index i;
    int k;
    s.c = cloud_lattice(dim, side[dim], 1.3, 0.25, (uint64_t)dim);
    s.a[0] = (sph_real *)cloud_memory((size_t)ARRAYS * (size_t)s.c.n, sizeof *s.a[0]);
    for (k = 1; k < ARRAYS; k++) s.a[k] = s.a[0] + k * s.c.n;
    pcg32_seed(&g, 78, (uint64_t)(10 * dim + own));
    for (i = 0; i < s.c.n; i++) {
        s.a[M][i] = SPH_R(pow(s.c.dx, dim) * (1.0 + 0.5 * cloud_symmetric(&g)));
        s.a[RHO][i] = SPH_R(1.0 + 0.5 * cloud_symmetric(&g));
        s.a[H][i] = s.c.h * SPH_R(own ? 1.0 + 0.3 * cloud_symmetric(&g) : 1.0);
        s.a[OMEGA][i] = SPH_R(own ? 1.0 + 0.2 * cloud_symmetric(&g) : 1.0);
        s.a[P][i] = SPH_R(1.0 + 0.5 * cloud_symmetric(&g));
        s.a[U][i] = SPH_R(2.0 + cloud_symmetric(&g));
        s.a[CS][i] = SPH_R(1.3 + 0.3 * cloud_symmetric(&g));
        s.a[ALPHA][i] = SPH_R(1.0 + 0.9 * cloud_symmetric(&g));
        s.a[ETA][i] = SPH_R(pcg32_uniform(&g));
        for (k = 0; k < 3; k++) {
            s.a[VX + k][i] = SPH_R(k < dim ? cloud_symmetric(&g) : 0.0);
            s.a[BX + k][i] = SPH_R(cloud_symmetric(&g));
        }
    }
    lists(&s);
    return s;
}
static void state_free(state *s)
{
    cloud_free(&s->c);
    free(s->a[0]);
}

/* the rates of magnetised gas without a field */
static void test_magnetised(void)
{
    int dim, own, k;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++) {
            state s = random_state(dim, own);
            sph_mhd m;
            sph_mhd_out o = {0};
            double worst[4] = {0, 0, 0, 0}, size[4] = {0, 0, 0, 0};
            sph_index i;
            rates(&s, gas(&s, SPH_CONDUCTIVITY_PRICE));
            m.medium = medium(&s);
            m.p = field(&s, P);
            m.u = field(&s, U);
            m.cs = field(&s, CS);
            m.alpha = field(&s, ALPHA);
            m.alpha_B = field(&s, ALPHA);
            m.v = three(&s, VX, dim);
            m.field = sph_vectors_separate(s.a[ZERO], s.a[ZERO], dim > 2 ? s.a[ZERO] : 0);
            m.psi = sph_scalars_none();
            m.ch = m.sigma = SPH_R(0);
            m.beta = SPH_R(2);
            m.alpha_u = SPH_R(0.8);
            m.tensile = SPH_R(1);
            o.acceleration = three_out(&s, CX);
            o.rate_B = three_out(&s, BX);
            o.rate_u = s.a[RV];
            o.div_v = s.a[DIV2];
            o.v_sig = s.a[VSIG2];
            CHECK(sph_mhd_rates(KERNEL, dim, view(&s), m, o) == 0);
            for (i = 0; i < s.c.n; i++) {
                static const int pairs[][2] = {{RU, RV}, {DIV, DIV2}, {VSIG, VSIG2}};
                for (k = 0; k < dim; k++) {
                    worst[0] = fmax(worst[0], fabs((double)(s.a[AX + k][i] - s.a[CX + k][i])));
                    size[0] = fmax(size[0], fabs((double)s.a[CX + k][i]));
                }
                for (k = 0; k < 3; k++) {
                    worst[k + 1] = fmax(worst[k + 1], fabs((double)(s.a[pairs[k][0]][i] - s.a[pairs[k][1]][i])));
                    size[k + 1] = fmax(size[k + 1], fabs((double)s.a[pairs[k][1]][i]));
                }
            }
            for (k = 0; k < 4; k++) {
                static const char *const name[] = {"acceleration", "rate of u", "div v", "v_sig"};
                CHECK(size[k] > 0.0);
                CHECK_WORST(check_words("%s of gas beside magnetised gas in %dD", name[k], dim), worst[k], BY_PRECISION(1e-13, 1e-5) * size[k]);
            }
            state_free(&s);
        }
}

/* momentum, angular momentum, energy; the sign of each dissipation */
static void test_conserved(void)
{
    int dim, own, form, k;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (form = SPH_CONDUCTIVITY_NONE; form <= (int)SPH_CONDUCTIVITY_WADSLEY; form++) {
                state s = random_state(dim, own);
                double p[3] = {0, 0, 0}, turn[3] = {0, 0, 0}, force = 0.0, energy = 0.0, power = 0.0, conducted = 0.0, mixed = 0.0, moved = 0.0;
                sph_gas g = gas(&s, form);
                sph_index i;
                rates(&s, g);
                for (i = 0; i < s.c.n; i++) {
                    const double m = (double)s.a[M][i];
                    double x[3];
                    cloud_position(&s.c, i, x);
                    for (k = 0; k < 3; k++) {
                        const int l = (k + 1) % 3, n = (k + 2) % 3;
                        const double a = k < dim ? (double)s.a[AX + k][i] : 0.0, al = l < dim ? (double)s.a[AX + l][i] : 0.0, an = n < dim ? (double)s.a[AX + n][i] : 0.0;
                        p[k] += m * a;
                        turn[k] += m * (x[l] * an - x[n] * al);
                        force += fabs(m * a);
                        energy += m * a * (double)s.a[VX + k][i];
                        power += fabs(m * a * (double)s.a[VX + k][i]);
                    }
                    energy += m * (double)s.a[RU][i];
                    power += fabs(m * (double)s.a[RU][i]);
                }
                for (k = 0; k < 3; k++) {
                    CHECK_CLOSE(p[k], 0.0, 100.0 * EPSILON * force);
                    CHECK_CLOSE(turn[k], 0.0, 100.0 * EPSILON * force);
                }
                CHECK_CLOSE(energy, 0.0, 100.0 * EPSILON * power);
                /* without pressure's work and viscosity there is conductivity alone: P is in its speed only, and work is taken off by the divergence */
                for (i = 0; i < s.c.n; i++) s.a[ALPHA][i] = SPH_R(0);
                rates(&s, g);
                for (i = 0; i < s.c.n; i++) s.a[RV][i] = s.a[RU][i] + s.a[P][i] / s.a[RHO][i] * s.a[DIV][i];
                for (i = 0; i < s.c.n; i++) {
                    const double heat = (double)s.a[M][i] * (double)s.a[RV][i];
                    conducted += heat;
                    mixed += heat * (double)s.a[U][i];
                    moved += fabs(heat);
                }
                CHECK_CLOSE(conducted, 0.0, 300.0 * EPSILON * power);
                if (form == (int)SPH_CONDUCTIVITY_NONE) CHECK_CLOSE(moved, 0.0, 300.0 * EPSILON * power);
                else CHECK(mixed < -1e-3 * moved && moved > 1e-3 * power);
                /* viscosity alone heats */
                for (i = 0; i < s.c.n; i++) s.a[ALPHA][i] = SPH_R(1);
                g.conductivity = SPH_CONDUCTIVITY_NONE;
                rates(&s, g);
                for (i = 0; i < s.c.n; i++) {
                    const double work = -(double)s.a[P][i] / (double)s.a[RHO][i] * (double)s.a[DIV][i];
                    CHECK_AT("heat of viscosity", i, (double)s.a[RU][i] - work >= -100.0 * EPSILON * (fabs(work) + power));
                    moved += (double)s.a[RU][i] - work;
                }
                CHECK(moved > 0.0);
                state_free(&s);
            }
}

/* an atmosphere at rest: u jumps, P has a slope. |w| conducts nothing at all, Price's form does */
static void test_atmosphere(void)
{
    int dim, form;
    for (dim = 1; dim <= 3; dim++)
        for (form = SPH_CONDUCTIVITY_NONE; form <= (int)SPH_CONDUCTIVITY_WADSLEY; form++) {
            state s = random_state(dim, 1);
            double most = 0.0;
            sph_index i;
            int k;
            for (i = 0; i < s.c.n; i++)
                for (k = 0; k < dim; k++) s.a[VX + k][i] = SPH_R(0);
            rates(&s, gas(&s, form));
            for (i = 0; i < s.c.n; i++) most = fmax(most, fabs((double)s.a[RU][i]));
            if (form == (int)SPH_CONDUCTIVITY_PRICE) CHECK(most > 0.1);
            else CHECK(most == 0.0);
            state_free(&s);
        }
}

/* grad v of linear velocities: exact where it is renormalised, also at the boundary; what the switches make of shear, compression, expansion and rotation */
static void test_gradient(void)
{
    static const double flow[4][3][3] = {{{0, 1.5, 0}, {0, 0, 0}, {0, 0, 0}}, {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0.3, 1.1, -0.4}, {-0.7, 0.5, 0.9}, {0.2, -1.3, -0.6}}};
    int dim, which;
    for (dim = 1; dim <= 3; dim++)
        for (which = 0; which < 4; which++) {
            state s = random_state(dim, 1);
            const double allowed = BY_PRECISION(1e-11, 1e-3);
            double div = 0.0, curl = 0.0, shear = 0.0, square = 0.0;
            sph_velocity_gradient_out o = {0};
            sph_shock_out indicator = {0};
            sph_gas g = gas(&s, 0);
            sph_index i;
            int a, b;
            if (dim == 1 && which == 0) {
                state_free(&s);
                continue;
            }
            for (i = 0; i < s.c.n; i++) {
                double x[3];
                cloud_position(&s.c, i, x);
                for (a = 0; a < dim; a++) {
                    double v = 0.2;
                    for (b = 0; b < dim; b++) v += flow[which][a][b] * x[b];
                    s.a[VX + a][i] = SPH_R(v);
                }
            }
            for (a = 0; a < dim; a++) div += flow[which][a][a];
            for (a = 0; a < dim; a++)
                for (b = 0; b < dim; b++) {
                    const double G = flow[which][a][b], T = flow[which][b][a], S = 0.5 * (G + T) - (a == b ? div / dim : 0.0);
                    shear += S * S;
                    square += G * T;
                    curl += 0.5 * (G - T) * (G - T);
                }
            o.div = s.a[DIV];
            o.curl = s.a[CURL];
            o.shear = s.a[SHEAR];
            o.square = s.a[SQUARE];
            o.x = three_out(&s, AX);
            o.y = three_out(&s, CX);
            CHECK(sph_velocity_gradient_cspm(KERNEL, dim, view(&s), g.v, o) == 0);
            for (i = 0; i < s.c.n; i++) {
                CHECK_NEAR("div v", i, s.a[DIV][i], div, allowed);
                CHECK_NEAR("|curl v|", i, s.a[CURL][i], sqrt(curl), allowed);
                CHECK_NEAR("S : S", i, s.a[SHEAR][i], shear, allowed);
                CHECK_NEAR("tr (grad v)^2", i, s.a[SQUARE][i], square, allowed);
                for (b = 0; b < dim; b++) {
                    CHECK_NEAR("grad v_x", i, s.a[AX + b][i], flow[which][0][b], allowed);
                    if (dim > 1) CHECK_NEAR("grad v_y", i, s.a[CX + b][i], flow[which][1][b], allowed);
                }
            }
            indicator.ratio = s.a[RATIO];
            indicator.v_sig = s.a[VSIG];
            /* the density of the same sum, so that R is in [-1, 1] */
            for (i = 0; i < s.c.n; i++) {
                sph_index q;
                s.a[RHO][i] = s.a[M][i] * sph_kernel_w(KERNEL, dim, SPH_R(0), s.a[H][i]);
                for (q = s.c.start[i]; q < s.c.start[i + 1]; q++) {
                    double xi[3], xj[3];
                    cloud_position(&s.c, i, xi);
                    cloud_position(&s.c, s.c.index[q], xj);
                    s.a[RHO][i] += s.a[M][s.c.index[q]] * sph_kernel_w(KERNEL, dim, SPH_R(sqrt(pow(xi[0] - xj[0], 2) + pow(xi[1] - xj[1], 2) + pow(xi[2] - xj[2], 2))), s.a[H][i]);
                }
            }
            CHECK(sph_shock_indicator(KERNEL, dim, view(&s), g, field(&s, DIV), indicator) == 0);
            for (i = 0; i < s.c.n; i++) {
                const sph_flow f = {s.a[DIV][i], s.a[CURL][i], s.a[SHEAR][i], s.a[SQUARE][i]};
                const double ratio = (double)s.a[RATIO][i], xi = (double)sph_shock_factor_cullen_dehnen(f, s.a[RATIO][i]), phantom = (double)sph_shock_factor_phantom(f),
                             balsara = (double)sph_viscosity_factor_balsara(f, SPH_R(0), s.a[H][i]);
                CHECK_AT("the factors are in [0, 1]", i, xi >= 0.0 && xi <= 1.0 && phantom >= 0.0 && phantom <= 1.0 && balsara >= 0.0 && balsara <= 1.0);
                CHECK_AT("R is in [-1, 1]", i, fabs(ratio) <= 1.0 + 100.0 * EPSILON);
                if (which == 0) { /* pure shear: div v is rounding */
                    CHECK_NEAR("xi in shear", i, xi, 0.0, BY_PRECISION(1e-10, 1e-2));
                    CHECK_NEAR("Phantom's xi in shear", i, phantom, 0.0, BY_PRECISION(1e-10, 1e-2));
                    CHECK_NEAR("Balsara's factor in shear", i, balsara, 0.0, BY_PRECISION(1e-10, 1e-2));
                }
                if (which == 1) {
                    CHECK_NEAR("R in compression", i, ratio, -1.0, 100.0 * EPSILON);
                    CHECK_NEAR("xi in compression", i, xi, 1.0, BY_PRECISION(1e-10, 1e-3));
                    CHECK_NEAR("Phantom's xi in compression", i, phantom, 1.0, BY_PRECISION(1e-10, 1e-3));
                    CHECK_NEAR("Balsara's factor in compression", i, balsara, 1.0, BY_PRECISION(1e-10, 1e-2));
                }
                if (which == 2) {
                    CHECK_NEAR("R in expansion", i, ratio, 1.0, 100.0 * EPSILON);
                }
            }
            state_free(&s);
        }
}

/* the difference form is the divergence of the rates; the signal speed of the indicator by hand */
static void test_difference(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        state s = random_state(dim, 1);
        sph_velocity_gradient_out o = {0};
        sph_shock_out indicator = {0};
        sph_index i, q;
        double size = 0.0;
        int k;
        rates(&s, gas(&s, 0));
        o.div = s.a[DIV2];
        o.curl = s.a[CURL];
        CHECK(sph_velocity_gradient_difference(KERNEL, dim, view(&s), medium(&s), three(&s, VX, dim), o) == 0);
        CHECK(sph_curl_difference(KERNEL, dim, view(&s), medium(&s), sph_vectors_separate(s.a[VX], s.a[VY], s.a[VZ]), three_out(&s, CX)) == 0);
        for (i = 0; i < s.c.n; i++) size = fmax(size, fabs((double)s.a[DIV][i]));
        indicator.ratio = s.a[RATIO];
        indicator.v_sig = s.a[VSIG];
        CHECK(sph_shock_indicator(KERNEL, dim, view(&s), gas(&s, 0), field(&s, DIV), indicator) == 0);
        for (i = 0; i < s.c.n; i++) {
            double fastest = (double)s.a[CS][i], curl = 0.0, xi[3], R;
            CHECK_NEAR("div v of the gradient", i, s.a[DIV2][i], s.a[DIV][i], 200.0 * EPSILON * size);
            for (k = 0; k < 3; k++) curl += pow((double)s.a[CX + k][i], 2.0);
            if (dim > 1) CHECK_NEAR("|curl v| of the gradient", i, s.a[CURL][i], sqrt(curl), 300.0 * EPSILON * size);
            cloud_position(&s.c, i, xi);
            R = (double)(s.a[M][i] * sph_kernel_w(KERNEL, dim, SPH_R(0), s.a[H][i])) * (s.a[DIV][i] > 0 ? 1.0 : -1.0);
            for (q = s.c.start[i]; q < s.c.start[i + 1]; q++) {
                const sph_index j = s.c.index[q];
                double xj[3], r = 0.0, w = 0.0;
                cloud_position(&s.c, j, xj);
                for (k = 0; k < dim; k++) {
                    r += (xi[k] - xj[k]) * (xi[k] - xj[k]);
                    w += (xi[k] - xj[k]) * (double)(s.a[VX + k][i] - s.a[VX + k][j]);
                }
                r = sqrt(r);
                if (r < 2.0 * fmax((double)s.a[H][i], (double)s.a[H][j])) fastest = fmax(fastest, 0.5 * (double)(s.a[CS][i] + s.a[CS][j]) - fmin(w / r, 0.0));
                R += (double)(s.a[M][j] * sph_kernel_w(KERNEL, dim, SPH_R(r), s.a[H][i])) * (s.a[DIV][j] > 0 ? 1.0 : -1.0);
            }
            CHECK_NEAR("v_sig of the indicator", i, s.a[VSIG][i], fastest, 100.0 * EPSILON * fastest);
            CHECK_NEAR("R", i, s.a[RATIO][i], R / (double)s.a[RHO][i], 200.0 * EPSILON);
        }
        state_free(&s);
    }
}

/* targets, and how alpha follows them */
static void test_targets(void)
{
    const sph_switch s = {SPH_R(0.4), SPH_R(0.1), SPH_R(2)};
    sph_shock k = {SPH_R(-3), SPH_R(0.5), SPH_R(0.2), SPH_R(1.5), SPH_R(2)};
    const sph_flow none = {0, 0, 0, 0}, out = {SPH_R(1), 0, 0, 0}, turning = {SPH_R(1), SPH_R(1e-3), 0, 0};
    const double a = 0.2 * 0.2 * 0.5 * 3.0, decayed = 0.15 + 0.25 * exp(-0.1 * 0.7 * 2.0 / 0.2);
    CHECK_RELATIVE((double)sph_viscosity_target_cullen_dehnen(s, k), fmax(0.1, 2.0 * a / (4.0 + a)), 32.0 * EPSILON);
    CHECK_RELATIVE((double)sph_viscosity_target_phantom(s, k), 10.0 * a / 2.25, 32.0 * EPSILON);
    k.rate = SPH_R(-300);
    CHECK_RELATIVE((double)sph_viscosity_target_cullen_dehnen(s, k), 2.0 * 100.0 * a / (4.0 + 100.0 * a), 32.0 * EPSILON);
    CHECK((double)sph_viscosity_target_phantom(s, k) == 2.0);
    k.cs = SPH_R(0);
    CHECK((double)sph_viscosity_target_phantom(s, k) == 2.0);
    k.rate = SPH_R(300);
    CHECK((double)sph_viscosity_target_phantom(s, k) == (double)s.least && (double)sph_viscosity_target_cullen_dehnen(s, k) == (double)s.least);
    CHECK((double)sph_viscosity_switch_after(s, k, SPH_R(0.9), SPH_R(0)) == (double)SPH_R(0.9));
    CHECK_RELATIVE((double)sph_viscosity_switch_after(s, k, SPH_R(0.15), SPH_R(0.7)), decayed, 64.0 * EPSILON);
    CHECK((double)sph_shock_factor_cullen_dehnen(none, SPH_R(0)) == 1.0 && (double)sph_shock_factor_cullen_dehnen(out, SPH_R(1)) == 0.0);
    CHECK((double)sph_shock_factor_phantom(none) == 1.0 && (double)sph_shock_factor_phantom(out) == 1.0 && (double)sph_shock_factor_phantom(turning) == 0.0);
}

/* Ohmic: energy and the sum of m B / rho are kept, heat is not negative, constants do nothing, eta lap B of a wave */
static void test_ohmic(void)
{
    int dim, own, k;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++) {
            state s = random_state(dim, own);
            sph_ohmic state_of;
            sph_ohmic_out o = {0};
            double energy = 0.0, all = 0.0, total[3] = {0, 0, 0}, size = 0.0;
            sph_index i;
            state_of.medium = medium(&s);
            state_of.eta = field(&s, ETA);
            state_of.field = three(&s, BX, 3);
            o.rate_B = three_out(&s, CX);
            o.rate_u = s.a[RU];
            CHECK(sph_resistivity_ohmic(KERNEL, dim, view(&s), state_of, o) == 0);
            for (i = 0; i < s.c.n; i++) {
                const double m = (double)s.a[M][i], rho = (double)s.a[RHO][i];
                CHECK_AT("heat of resistivity", i, s.a[RU][i] >= 0);
                energy += m * (double)s.a[RU][i];
                all += m * (double)s.a[RU][i];
                for (k = 0; k < 3; k++) {
                    energy += m * (double)s.a[BX + k][i] * (double)s.a[CX + k][i] / rho;
                    total[k] += m * (double)s.a[CX + k][i] / rho;
                    size += fabs(m * (double)s.a[CX + k][i] / rho);
                }
            }
            CHECK(all > 0.0);
            CHECK_CLOSE(energy, 0.0, 300.0 * EPSILON * all);
            for (k = 0; k < 3; k++) CHECK_CLOSE(total[k], 0.0, 300.0 * EPSILON * size);
            for (i = 0; i < s.c.n; i++)
                for (k = 0; k < 3; k++) s.a[BX + k][i] = SPH_R(1.7);
            CHECK(sph_resistivity_ohmic(KERNEL, dim, view(&s), state_of, o) == 0);
            for (i = 0; i < s.c.n; i++) CHECK_AT("a constant field stays", i, s.a[CX][i] == 0 && s.a[CY][i] == 0 && s.a[CZ][i] == 0 && s.a[RU][i] == 0);
            state_free(&s);
        }
}
/* a sine on a periodic line decays at the rate eta k^2, and a step that is four times too long grows: the limit means something */
static void test_ohmic_decay(void)
{
    enum { SIDE = 64 };
    const double dx = 1.0 / SIDE, wave = 2.0 * PI, eta_value = 0.3;
    const sph_real h = SPH_R(1.2 * dx), one = SPH_R(1), m = SPH_R(dx), eta = SPH_R(eta_value), dt = sph_time_step_resistivity(h, eta);
    sph_real x[SIDE], by[SIDE], rate[SIDE], zero[SIDE];
    sph_index start[SIDE + 1], index[SIDE * 4];
    sph_cloud c;
    sph_ohmic s;
    sph_ohmic_out o = {0};
    sph_list list;
    int i, k, times, step;
    for (i = 0; i < SIDE; i++) {
        x[i] = SPH_R((i + 0.5) * dx);
        start[i] = (sph_index)(4 * i);
        for (k = 0; k < 4; k++) index[4 * i + k] = (sph_index)((i + (k < 2 ? k - 2 : k - 1) + SIDE) % SIDE);
    }
    start[SIDE] = 4 * SIDE;
    list.start = start;
    list.index = index;
    c = sph_cloud_of(sph_points_periodic(sph_points_separate(SIDE, x, 0, 0), one, SPH_R(0), SPH_R(0)), list, sph_scalars_same(&h), sph_scalars_none());
    s.medium.m = sph_scalars_same(&m);
    s.medium.rho = s.medium.omega = sph_scalars_same(&one);
    s.eta = sph_scalars_same(&eta);
    s.field = sph_vectors_separate(by, 0, 0);
    o.rate_B = sph_vector_out_separate(rate, zero, zero);
    for (times = 1; times <= 16; times *= 16) {
        double largest = 0.0;
        for (i = 0; i < SIDE; i++) by[i] = SPH_R(sin(wave * (double)x[i]) + 1e-4 * (i % 2 ? 1 : -1));
        for (step = 0; step < 400; step++) {
            CHECK(sph_resistivity_ohmic(KERNEL, 1, c, s, o) == 0);
            if (step == 0 && times == 1)
                for (i = 0; i < SIDE; i++) CHECK_NEAR("eta lap B", i, rate[i], -eta_value * wave * wave * sin(wave * (double)x[i]), 0.06 * eta_value * wave * wave);
            for (i = 0; i < SIDE; i++) by[i] += SPH_R(times) * dt * rate[i];
            if (times > 1 && fabs((double)by[0]) > 1e6) break;
        }
        for (i = 0; i < SIDE; i++) largest = fmax(largest, fabs((double)by[i]));
        if (times == 1) CHECK_RELATIVE(largest, exp(-eta_value * wave * wave * 400.0 * (double)dt), 0.06);
        else CHECK(largest > 1e3);
    }
}

int main(void)
{
    test_magnetised();
    test_conserved();
    test_atmosphere();
    test_gradient();
    test_difference();
    test_targets();
    test_ohmic();
    test_ohmic_decay();
    return check_report("test_gas");
}
