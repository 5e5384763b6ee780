/* SPDX-License-Identifier: MIT */
/*
 * test_cleaning.c - magnetohydrodynamics and divergence cleaning: conjugate operators, what is conserved at one instant on random states with an h of each particle's own, linear fields, and that the pair of operators
 * that is not conjugate conserves nothing.
 */
#include "one_copy.h"

#include "../examples/papers/cleaning_forms.h"
#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

#define KERNEL SPH_CUBIC_SPLINE
#define EPSILON ((double)SPH_EPSILON)

enum { M, RHO, OMEGA, H, P, U, CS, ALPHA, ALPHA_B, PSI, VX, VY, VZ, BX, BY, BZ, AX, AY, AZ, RBX, RBY, RBZ, RU, RPSI, DIVB, DIVV, VSIG, ARRAYS };
typedef struct state {
    cloud c;
    sph_real *a[ARRAYS];
} state;

static sph_vectors three(const state *s, int first, int parts)
{
    return sph_vectors_separate(s->a[first], parts > 1 ? s->a[first + 1] : 0, parts > 2 ? s->a[first + 2] : 0);
}
static sph_vector_out three_out(const state *s, int first) { return sph_vector_out_separate(s->a[first], s->a[first + 1], s->a[first + 2]); }
static sph_scalars field(const state *s, int which) { return sph_scalars_array(s->a[which]); }
static sph_medium gas(const state *s)
{
    sph_medium g;
    g.m = field(s, M);
    g.rho = field(s, RHO);
    g.omega = field(s, OMEGA);
    return g;
}

static sph_cloud state_cloud(const state *s, sph_scalars h)
{
    return sph_cloud_of(cloud_points(&s->c), cloud_list(&s->c), h, sph_scalars_none());
}

/* lists of all pairs within the larger support */
static void lists(state *s)
{
    sph_real *const R = (sph_real *)cloud_memory((size_t)s->c.n, sizeof *R);
    sph_index i;
    for (i = 0; i < s->c.n; i++) R[i] = SPH_R(2) * s->a[H][i];
    CHECK(cloud_search(&s->c, SPH_LARGER, sph_scalars_array(R)) == 0);
    free(R);
}
/* random in everything but what must be positive; h and Omega of each particle's own, or one h */
static state random_state(int dim, int own, int parts)
{
    static const int side[] = {0, 41, 17, 9};
    state s;
    pcg32 g;
    sph_index i;
    int k;
    s.c = cloud_lattice(dim, side[dim], 1.2, 0.25, (uint64_t)dim);
    s.a[0] = (sph_real *)cloud_memory((size_t)ARRAYS * (size_t)s.c.n, sizeof *s.a[0]);
    for (k = 1; k < ARRAYS; k++) s.a[k] = s.a[0] + k * s.c.n;
    pcg32_seed(&g, 77, (uint64_t)(10 * dim + own));
    for (i = 0; i < s.c.n; i++) {
        s.a[M][i] = SPH_R(pow(s.c.dx, dim) * (1.0 + 0.5 * cloud_symmetric(&g)));
        s.a[RHO][i] = SPH_R(1.0 + 0.5 * cloud_symmetric(&g));
        s.a[H][i] = s.c.h * SPH_R(own ? 1.0 + 0.3 * cloud_symmetric(&g) : 1.0);
        s.a[OMEGA][i] = SPH_R(own ? 1.0 + 0.2 * cloud_symmetric(&g) : 1.0);
        s.a[P][i] = SPH_R(1.0 + 0.5 * cloud_symmetric(&g));
        s.a[U][i] = SPH_R(2.0 + cloud_symmetric(&g));
        s.a[CS][i] = SPH_R(1.3 + 0.3 * cloud_symmetric(&g));
        s.a[ALPHA][i] = SPH_R(1.0 + 0.9 * cloud_symmetric(&g));
        s.a[PSI][i] = SPH_R(cloud_symmetric(&g));
        for (k = 0; k < 3; k++) {
            s.a[VX + k][i] = SPH_R(k < parts ? cloud_symmetric(&g) : 0.0);
            s.a[BX + k][i] = SPH_R(k < parts ? cloud_symmetric(&g) : 0.0);
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

enum { CONJUGATE, OTHER, DIFFERENCES };
static sph_index clean(int form, const state *s, double ch, double sigma, int moving)
{
    const sph_cloud all = state_cloud(s, field(s, H));
    const sph_cleaning_out out = {.rate_B = three_out(s, RBX), .rate_psi = s->a[RPSI], .div_B = s->a[DIVB]};
    const int dim = s->c.dim;
    sph_cleaning c;
    c.medium = gas(s);
    c.field = three(s, BX, dim);
    c.psi = field(s, PSI);
    c.div_v = moving ? field(s, DIVV) : sph_scalars_none();
    c.ch = SPH_R(ch);
    c.sigma = SPH_R(sigma);
    switch (form) {
    case CONJUGATE:
        return sph_cleaning_rates(KERNEL, dim, all, c, out);
    case OTHER:
        return cleaning_rates_symmetric(KERNEL, dim, all, c, out);
    default:
        return cleaning_rates_nonconservative(KERNEL, dim, all, c, out);
    }
}
/* resistivity of each particle's own, up to twice alpha_B */
static sph_mhd mhd(const state *s, int parts, int cleans, double alpha_B, double alpha_u, double tensile)
{
    sph_mhd m;
    sph_index i;
    for (i = 0; i < s->c.n; i++) s->a[ALPHA_B][i] = SPH_R(alpha_B * (1.0 + sin(7.0 * i)));
    m.medium = gas(s);
    m.p = field(s, P);
    m.u = field(s, U);
    m.cs = field(s, CS);
    m.alpha = field(s, ALPHA);
    m.alpha_B = field(s, ALPHA_B);
    m.v = three(s, VX, parts);
    m.field = three(s, BX, parts);
    m.psi = sph_scalars_array(cleans ? s->a[PSI] : 0);
    m.ch = SPH_R(1.7);
    m.sigma = SPH_R(0);
    m.beta = SPH_R(2);
    m.alpha_u = SPH_R(alpha_u);
    m.tensile = SPH_R(tensile);
    return m;
}
static sph_index rates(const state *s, sph_mhd m, sph_scalars h)
{
    sph_mhd_out o = {0};
    o.acceleration = three_out(s, AX);
    o.rate_B = three_out(s, RBX);
    o.rate_u = s->a[RU];
    o.rate_psi = s->a[RPSI];
    o.div_B = s->a[DIVB];
    o.div_v = s->a[DIVV];
    o.v_sig = s->a[VSIG];
    return sph_mhd_rates(KERNEL, s->c.dim, state_cloud(s, h), m, o);
}

/* ---- I1: sum V psi div B = -sum V B . grad psi; I2, I3, I4, I8 ---- */

static void test_conjugate(void)
{
    int dim, own, form;
    for (dim = 2; dim <= 3; dim++)
        for (own = 0; own < 2; own++) {
            state s = random_state(dim, own, dim);
            const sph_cloud view = state_cloud(&s, field(&s, H));
            const double ch = 1.7;
            double left = 0.0, right = 0.0, size = 0.0;
            sph_index i;
            int k;
            CHECK(sph_divergence_difference(KERNEL, dim, view, gas(&s), three(&s, BX, dim), sph_scalar_out_array(s.a[DIVB], 0)) == 0);
            CHECK(sph_gradient_symmetric(KERNEL, dim, view, gas(&s), field(&s, PSI), three_out(&s, AX)) == 0);
            for (i = 0; i < s.c.n; i++) {
                const double V = (double)s.a[M][i] / (double)s.a[RHO][i];
                left += V * (double)s.a[PSI][i] * (double)s.a[DIVB][i];
                size += fabs(V * (double)s.a[PSI][i] * (double)s.a[DIVB][i]);
                for (k = 0; k < dim; k++) right -= V * (double)s.a[BX + k][i] * (double)s.a[AX + k][i];
            }
            CHECK(fabs(left) > 1e-3 * size);
            CHECK_CLOSE(left, right, 50.0 * EPSILON * size);
            for (form = 0; form < 3; form++) {
                double rate = 0.0, all = 0.0, flux[3] = {0, 0, 0}, flux_size = 0.0, damping = 0.0, damped = 0.0;
                CHECK(clean(form, &s, ch, 0.0, 0) == 0);
                for (i = 0; i < s.c.n; i++) {
                    const double m = (double)s.a[M][i], rho = (double)s.a[RHO][i], psi = m * (double)s.a[PSI][i] * (double)s.a[RPSI][i] / (rho * ch * ch);
                    rate += psi;
                    all += fabs(psi);
                    for (k = 0; k < dim; k++) {
                        rate += m * (double)s.a[BX + k][i] * (double)s.a[RBX + k][i] / rho;
                        flux[k] += m / rho * (double)s.a[RBX + k][i];
                        flux_size += fabs(m / rho * (double)s.a[RBX + k][i]);
                    }
                }
                if (form == DIFFERENCES) CHECK(fabs(rate) > 1e-6 * all); /* I3: or this test could not fail */
                else CHECK_CLOSE(rate, 0.0, 50.0 * EPSILON * all);
                if (form == CONJUGATE) CHECK_CLOSE(fabs(flux[0]) + fabs(flux[1]) + fabs(flux[2]), 0.0, 50.0 * EPSILON * flux_size);
                else CHECK(fabs(flux[0]) + fabs(flux[1]) + fabs(flux[2]) > 1e-6 * flux_size);
                /* I4: with damping exactly this much less */
                CHECK(clean(form, &s, ch, 0.3, 0) == 0);
                for (i = 0; i < s.c.n; i++) {
                    const double m = (double)s.a[M][i], rho = (double)s.a[RHO][i], psi = (double)s.a[PSI][i];
                    damping += m * psi * psi * 0.3 / (rho * ch * (double)s.a[H][i]);
                    damped += m * psi * (double)s.a[RPSI][i] / (rho * ch * ch);
                    for (k = 0; k < dim; k++) damped += m * (double)s.a[BX + k][i] * (double)s.a[RBX + k][i] / rho;
                }
                CHECK_CLOSE(damped - rate, -damping, 100.0 * EPSILON * (all + damping));
            }
            state_free(&s);
        }
}

/* ---- I5, I6, I7: total energy and momentum of all of SPMHD ---- */

static void test_energy(void)
{
    int dim, own, parts, which;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (parts = dim; parts <= 3; parts += parts == dim && dim < 3 ? 3 - dim : 1)
                for (which = 0; which < 4; which++) { /* no dissipation, all dissipation, cleaning, all of it */
                    state s = random_state(dim, own, parts);
                    const int dissipates = which % 2, cleans = which / 2;
                    const double ch = 1.7;
                    sph_mhd m = mhd(&s, parts, cleans, dissipates ? 0.7 : 0.0, dissipates ? 1.0 : 0.0, 0.0);
                    double rate = 0.0, all = 0.0, p[3] = {0, 0, 0}, force = 0.0, power9 = 0.0, p9 = 0.0;
                    sph_index i;
                    int k;
                    if (!dissipates)
                        for (i = 0; i < s.c.n; i++) s.a[ALPHA][i] = SPH_R(0);
                    CHECK(rates(&s, m, field(&s, H)) == 0);
                    for (i = 0; i < s.c.n; i++) {
                        const double mi = (double)s.a[M][i], rho = (double)s.a[RHO][i], drho = -rho * (double)s.a[DIVV][i], psi = (double)s.a[PSI][i];
                        double term[4] = {0, 0, 0, 0}, B2 = 0.0;
                        for (k = 0; k < parts; k++) {
                            term[0] += mi * (double)s.a[VX + k][i] * (double)s.a[AX + k][i];
                            term[1] += mi * (double)s.a[BX + k][i] * (double)s.a[RBX + k][i] / rho;
                            B2 += (double)s.a[BX + k][i] * (double)s.a[BX + k][i];
                            p[k] += mi * (double)s.a[AX + k][i];
                            force += fabs(mi * (double)s.a[AX + k][i]);
                        }
                        term[1] -= mi * B2 / (2.0 * rho * rho) * drho;
                        term[2] = mi * (double)s.a[RU][i];
                        if (cleans) term[3] = mi * (psi * (double)s.a[RPSI][i] / (rho * ch * ch) - psi * psi / (2.0 * rho * rho * ch * ch) * drho);
                        for (k = 0; k < 4; k++) {
                            rate += term[k];
                            all += fabs(term[k]);
                        }
                    }
                    CHECK_CLOSE(rate, 0.0, 100.0 * EPSILON * all);
                    for (k = 0; k < 3; k++) CHECK_CLOSE(p[k], 0.0, 100.0 * EPSILON * force);
                    /* (9): its power is all that is missing, and momentum goes */
                    {
                        sph_real *const before[3] = {(sph_real *)cloud_memory((size_t)s.c.n, sizeof(sph_real)),
                                                     (sph_real *)cloud_memory((size_t)s.c.n, sizeof(sph_real)),
                                                     (sph_real *)cloud_memory((size_t)s.c.n, sizeof(sph_real))};
                        for (k = 0; k < 3; k++) memcpy(before[k], s.a[AX + k], (size_t)s.c.n * sizeof(sph_real));
                        m.tensile = SPH_R(1);
                        CHECK(rates(&s, m, field(&s, H)) == 0);
                        CHECK(sph_divergence_symmetric(KERNEL, dim, state_cloud(&s, field(&s, H)), gas(&s), three(&s, BX, dim), sph_scalar_out_array(s.a[RPSI], 0)) == 0);
                        for (i = 0; i < s.c.n; i++)
                            for (k = 0; k < parts; k++) {
                                const double f9 = (double)s.a[AX + k][i] - (double)before[k][i];
                                CHECK_CLOSE(f9, -(double)s.a[BX + k][i] * (double)s.a[RPSI][i] / (double)s.a[RHO][i],
                                            BY_PRECISION(1e-10, 1e-1) * (1.0 + 1.0 / s.c.dx));
                                power9 += fabs(f9);
                                p9 += (double)s.a[M][i] * f9;
                            }
                        CHECK(power9 > 0.0 && fabs(p9) > 1e-7 * force);
                        for (k = 0; k < 3; k++) free(before[k]);
                    }
                    state_free(&s);
                }
}

/* all of sph_mhd_rates again, from the equations, in double: what conservation does not see (means of the pair, factors of the dissipation) */
static void test_by_hand(void)
{
    int dim, own, parts;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (parts = dim; parts <= 3; parts += parts == dim && dim < 3 ? 3 - dim : 1) {
                state s = random_state(dim, own, parts);
                const sph_mhd m = mhd(&s, parts, 1, 0.6, 0.8, 0.7);
                double worst[5] = {0, 0, 0, 0, 0}, size[5] = {0, 0, 0, 0, 0};
                sph_index i, q;
                int k;
                CHECK(rates(&s, m, field(&s, H)) == 0);
                for (i = 0; i < s.c.n; i++) {
                    double a[3] = {0, 0, 0}, b[3] = {0, 0, 0}, u = 0.0, divB = 0.0, divv = 0.0, fastest = 0.0, psi, xi[3], Bi[3], vi[3];
                    const double ri = (double)s.a[RHO][i], oi = (double)s.a[OMEGA][i], hi = (double)s.a[H][i], Pi = (double)s.a[P][i];
                    cloud_position(&s.c, i, xi);
                    for (k = 0; k < 3; k++) {
                        Bi[k] = (double)s.a[BX + k][i];
                        vi[k] = (double)s.a[VX + k][i];
                    }
                    for (q = s.c.start[i]; q < s.c.start[i + 1]; q++) {
                        const sph_index j = s.c.index[q];
                        const double rj = (double)s.a[RHO][j], oj = (double)s.a[OMEGA][j], hj = (double)s.a[H][j], Pj = (double)s.a[P][j],
                                     mj = (double)s.a[M][j], mean = 0.5 * (ri + rj), resistivity = 0.5 * ((double)s.a[ALPHA_B][i] + (double)s.a[ALPHA_B][j]);
                        double xj[3], e[3], r = 0.0, w = 0.0, Bri = 0.0, Brj = 0.0, Fi, Fj, G, B2i = 0.0, B2j = 0.0, dB2 = 0.0, fast[2], vsig, gi, gj;
                        cloud_position(&s.c, j, xj);
                        for (k = 0; k < 3; k++) {
                            e[k] = xi[k] - xj[k];
                            r += e[k] * e[k];
                        }
                        r = sqrt(r);
                        for (k = 0; k < 3; k++) {
                            const double Bj = (double)s.a[BX + k][j];
                            e[k] /= r;
                            w += (vi[k] - (double)s.a[VX + k][j]) * e[k];
                            Bri += Bi[k] * e[k];
                            Brj += Bj * e[k];
                            B2i += Bi[k] * Bi[k];
                            B2j += Bj * Bj;
                            dB2 += (Bi[k] - Bj) * (Bi[k] - Bj);
                        }
                        Fi = (double)sph_kernel_dwdr(KERNEL, dim, SPH_R(r), SPH_R(hi)); /* dW/dr */
                        Fj = (double)sph_kernel_dwdr(KERNEL, dim, SPH_R(r), SPH_R(hj));
                        G = 0.5 * (Fi / oi + Fj / oj);
                        gi = Fi / (oi * ri * ri);
                        gj = Fj / (oj * rj * rj);
                        for (k = 0; k < 2; k++) {
                            const double c2 = pow((double)s.a[CS][k ? j : i], 2.0), va2 = k ? B2j / rj : B2i / ri, along = k ? Brj * Brj / rj : Bri * Bri / ri;
                            fast[k] = sqrt(0.5 * (c2 + va2 + sqrt(fmax(0.0, (c2 + va2) * (c2 + va2) - 4.0 * c2 * along))));
                        }
                        vsig = 0.5 * (fast[0] + fast[1] + 2.0 * fabs(w));
                        fastest = fmax(fastest, fmax(vsig, sqrt(pow((double)s.a[CS][i], 2.0) + B2i / ri)));
                        for (k = 0; k < 3; k++) {
                            const double Bj = (double)s.a[BX + k][j], vij = vi[k] - (double)s.a[VX + k][j];
                            a[k] += mj * ((Bi[k] * Bri - (Pi + 0.5 * B2i) * e[k]) * gi + (Bj * Brj - (Pj + 0.5 * B2j) * e[k]) * gj);
                            a[k] -= 0.7 * Bi[k] * mj * (Bri * gi + Brj * gj);
                            b[k] -= mj / (oi * ri) * (vij * Bri - Bi[k] * w) * Fi;
                            b[k] -= ri * mj * ((double)s.a[PSI][i] * gi + (double)s.a[PSI][j] * gj) * e[k];
                            b[k] += ri * mj * resistivity * vsig / (mean * mean) * (Bi[k] - Bj) * G;
                            if (w < 0.0) a[k] += mj * 0.5 * ((double)s.a[ALPHA][i] + (double)s.a[ALPHA][j]) * vsig * w / mean * G * e[k];
                        }
                        u += Pi / (oi * ri * ri) * mj * w * Fi;
                        if (w < 0.0) u -= 0.5 * mj * 0.5 * ((double)s.a[ALPHA][i] + (double)s.a[ALPHA][j]) * vsig * w * w / mean * G;
                        u += mj * 0.8 * sqrt(fabs(Pi - Pj) / mean) / mean * ((double)s.a[U][i] - (double)s.a[U][j]) * G;
                        u -= 0.5 * mj * resistivity * vsig / (mean * mean) * dB2 * G;
                        divB -= mj * (Bri - Brj) * Fi / (oi * ri);
                        divv -= mj * w * Fi / (oi * ri);
                    }
                    psi = -1.7 * 1.7 * divB - 0.5 * (double)s.a[PSI][i] * divv;
                    for (k = 0; k < parts; k++) {
                        worst[0] = fmax(worst[0], fabs(a[k] - (double)s.a[AX + k][i]));
                        worst[1] = fmax(worst[1], fabs(b[k] - (double)s.a[RBX + k][i]));
                        size[0] = fmax(size[0], fabs(a[k]));
                        size[1] = fmax(size[1], fabs(b[k]));
                    }
                    worst[2] = fmax(worst[2], fabs(u - (double)s.a[RU][i]));
                    worst[3] = fmax(worst[3], fabs(psi - (double)s.a[RPSI][i]));
                    size[2] = fmax(size[2], fabs(u));
                    size[3] = fmax(size[3], fabs(psi));
                    worst[4] = fmax(worst[4], fabs(fastest - (double)s.a[VSIG][i]));
                    size[4] = fmax(size[4], fastest);
                }
                for (k = 0; k < 5; k++) {
                    static const char *const name[] = {"acceleration", "rate of B", "rate of u",
                                                       "rate of psi", "v_sig"};
                    CHECK_WORST(check_words("%s beside sums by hand in %dD", name[k], dim), worst[k],
                                500.0 * EPSILON * size[k]);
                }
                state_free(&s);
            }
}

/* heating by viscosity and resistivity is never negative; switched off there is none */
static void test_heating(void)
{
    state s = random_state(2, 1, 3);
    sph_mhd m = mhd(&s, 3, 0, 0.0, 0.0, 1.0);
    sph_real *const zero = (sph_real *)cloud_memory((size_t)s.c.n, sizeof *zero);
    double *const none = (double *)cloud_memory((size_t)s.c.n, sizeof *none);
    sph_index i;
    int hot = 0;
    m.alpha = sph_scalars_array(zero);
    CHECK(rates(&s, m, field(&s, H)) == 0);
    for (i = 0; i < s.c.n; i++) none[i] = (double)s.a[RU][i];
    m.alpha_B = field(&s, ALPHA);
    CHECK(rates(&s, m, field(&s, H)) == 0);
    for (i = 0; i < s.c.n; i++)
        CHECK_AT("heating by resistivity", i, (double)s.a[RU][i] >= none[i] - BY_PRECISION(1e-12, 1e-3));
    m.alpha_B = sph_scalars_array(zero);
    m.alpha = field(&s, ALPHA);
    CHECK(rates(&s, m, field(&s, H)) == 0);
    for (i = 0; i < s.c.n; i++) {
        CHECK_AT("heating by viscosity", i, (double)s.a[RU][i] >= none[i] - BY_PRECISION(1e-12, 1e-3));
        hot += (double)s.a[RU][i] > none[i] + 1e-3;
    }
    CHECK(hot > s.c.n / 2);
    free(zero);
    free(none);
    state_free(&s);
}

/* ---- linear fields on a lattice: signs and factors; one h with stride 0 and one in an array give the same ---- */

static void test_linear(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        static const int side[] = {0, 41, 21, 13};
        state s;
        const double B0[3] = {0.7, -0.4, 0.3};
        sph_index i, middle;
        sph_cloud one;
        sph_mhd m;
        double G;
        int k;
        s.c = cloud_lattice(dim, side[dim], 1.2, 0.0, 1);
        middle = s.c.n / 2;
        s.a[0] = (sph_real *)cloud_memory((size_t)ARRAYS * (size_t)s.c.n, sizeof *s.a[0]);
        for (k = 1; k < ARRAYS; k++) s.a[k] = s.a[0] + k * s.c.n;
        for (i = 0; i < s.c.n; i++) {
            double x[3];
            cloud_position(&s.c, i, x);
            s.a[M][i] = SPH_R(2.0 * pow(s.c.dx, dim));
            s.a[RHO][i] = SPH_R(2);
            s.a[OMEGA][i] = s.a[CS][i] = SPH_R(1);
            s.a[H][i] = s.c.h;
            s.a[PSI][i] = SPH_R(0.9 * x[0]);
            s.a[P][i] = SPH_R(3.0 - 0.8 * x[0]);
            for (k = 0; k < 3; k++) {
                s.a[BX + k][i] = SPH_R(B0[k]);
                s.a[VX + k][i] = SPH_R((k + 1) * 0.5 * x[0]); /* v = (.5, 1, 1.5) x */
            }
        }
        m = mhd(&s, 3, 1, 0.0, 0.0, 1.0);
        m.sigma = SPH_R(0.3);
        CHECK(rates(&s, m, cloud_h(&s.c)) == 0);
        {
            const double ax = (double)s.a[AX][middle], bx = (double)s.a[RBX][middle];
            CHECK(rates(&s, m, field(&s, H)) == 0);
            CHECK_NEAR("acceleration along x", middle, s.a[AX][middle], ax, 1e-12);
            CHECK_NEAR("dB_x/dt", middle, s.a[RBX][middle], bx, 1e-12);
        }
        G = (double)s.a[DIVV][middle] / 0.5; /* the lattice's factor */
        CHECK_CLOSE(G, 1.0, 0.05);
        CHECK_NEAR("acceleration along x", middle, s.a[AX][middle], 0.4 * G,
                   BY_PRECISION(1e-10, 1e-3)); /* -grad P / rho */
        CHECK_NEAR("div B", middle, s.a[DIVB][middle], 0.0, BY_PRECISION(1e-12, 1e-3));
        /* dB/dt = (B . grad) v - B div v - grad psi */
        CHECK_NEAR("dB_x/dt", middle, s.a[RBX][middle], G * (B0[0] * 0.5 - B0[0] * 0.5 - 0.9),
                   BY_PRECISION(1e-10, 2e-3));
        CHECK_NEAR("dB_y/dt", middle, s.a[RBY][middle], G * (B0[0] * 1.0 - B0[1] * 0.5),
                   BY_PRECISION(1e-10, 1e-3));
        CHECK_NEAR("dB_z/dt", middle, s.a[RBZ][middle], G * (B0[0] * 1.5 - B0[2] * 0.5),
                   BY_PRECISION(1e-10, 1e-3));
        CHECK_NEAR("du/dt", middle, s.a[RU][middle], -(double)s.a[P][middle] / 2.0 * 0.5 * G,
                   BY_PRECISION(1e-10, 1e-3));
        { /* dpsi/dt = -ch^2 div B - sigma ch psi / h - psi div v / 2 */
            const double psi = (double)s.a[PSI][middle];
            CHECK_NEAR("dpsi/dt", middle, s.a[RPSI][middle],
                       -0.3 * 1.7 / (double)s.c.h * psi - 0.25 * G * psi, BY_PRECISION(1e-9, 1e-2));
        }
        /* magnetic pressure and tension: B = (1, 2 x, x): curl x B = (-d(B^2/2)/dx + ..., B_x dB_y/dx, B_x dB_z/dx) */
        for (i = 0; i < s.c.n; i++) {
            s.a[BX][i] = SPH_R(1);
            s.a[BY][i] = SPH_R(2) * s.c.x[i];
            s.a[BZ][i] = s.c.x[i];
            s.a[P][i] = SPH_R(1);
            s.a[VX][i] = s.a[VY][i] = s.a[VZ][i] = s.a[ALPHA][i] = SPH_R(0);
        }
        CHECK(rates(&s, m, cloud_h(&s.c)) == 0);
        CHECK_NEAR("acceleration along y", middle, s.a[AY][middle], G * 2.0 / 2.0, BY_PRECISION(1e-9, 1e-2));
        CHECK_NEAR("acceleration along z", middle, s.a[AZ][middle], G * 1.0 / 2.0, BY_PRECISION(1e-9, 1e-2));
        CHECK_NEAR("acceleration along x", middle, s.a[AX][middle], -G * 5.0 * (double)s.c.x[middle] / 2.0,
                   BY_PRECISION(1e-9, 1e-2)); /* -d(5 x^2 / 2)/dx / rho */
        one = sph_cloud_range(state_cloud(&s, field(&s, H)), middle, middle + 1);
        CHECK(sph_curl_difference(KERNEL, dim, one, gas(&s), three(&s, BX, 3), three_out(&s, RBX)) == 0);
        CHECK_NEAR("dB_x/dt", middle, s.a[RBX][middle], 0.0, BY_PRECISION(1e-10, 1e-3));
        CHECK_NEAR("dB_y/dt", middle, s.a[RBY][middle], -G, BY_PRECISION(1e-10, 1e-3)); /* -dB_z/dx */
        CHECK_NEAR("dB_z/dt", middle, s.a[RBZ][middle], 2.0 * G, BY_PRECISION(1e-10, 1e-3));
        CHECK(sph_divergence_difference(KERNEL, dim, one, gas(&s), three(&s, BY, dim), sph_scalar_out_array(s.a[DIVB], 0)) == 0);
        CHECK_NEAR("div B", middle, s.a[DIVB][middle], 2.0 * G,
                   BY_PRECISION(1e-10, 1e-3)); /* of (2 x, x, ...) */
        state_free(&s);
    }
}

/* ---- scalars ---- */

static void test_values(void)
{
    const sph_cleaning_wave wave = {.ch = SPH_R(2), .sigma = SPH_R(0.5), .h = SPH_R(0.1)};
    const sph_switch alpha = {.alpha = SPH_R(0.5), .least = SPH_R(0.1), .most = SPH_R(2)};
    sph_vec B = {SPH_R(3), SPH_R(0), SPH_R(4)}, a = {SPH_R(0), SPH_R(2), SPH_R(0)}, b = {SPH_R(0), SPH_R(0), SPH_R(1)}, c;
    /* along B: the larger of cs and vA; across: sqrt(cs^2 + vA^2); vA^2 = 25 / 4 */
    CHECK_RELATIVE((double)sph_mhd_fast_speed(SPH_R(1), B, SPH_R(4), SPH_R(5)), 2.5, 16.0 * EPSILON);
    CHECK_RELATIVE((double)sph_mhd_fast_speed(SPH_R(3), B, SPH_R(4), SPH_R(5)), 3.0, 16.0 * EPSILON);
    CHECK_RELATIVE((double)sph_mhd_fast_speed(SPH_R(1), B, SPH_R(4), SPH_R(0)), sqrt(7.25), 16.0 * EPSILON);
    CHECK_RELATIVE((double)sph_signal_speed(SPH_R(1), SPH_R(2), SPH_R(2 * 3)), 4.5, 8.0 * EPSILON);
    CHECK_RELATIVE((double)sph_cleaning_sigma(2), 0.3, 2.0 * EPSILON);
    CHECK(sph_cleaning_sigma(1) == sph_cleaning_sigma(2) && sph_cleaning_sigma(3) == SPH_R(1));
    CHECK_RELATIVE((double)sph_conductivity_speed(SPH_R(1), SPH_R(9), SPH_R(0.5)), 2.0, 8.0 * EPSILON);
    CHECK_RELATIVE((double)sph_cleaning_rate(wave, SPH_R(3), SPH_R(7), SPH_R(4)),
                   -4.0 * 7.0 - 10.0 * 3.0 - 6.0, 8.0 * EPSILON);
    CHECK_RELATIVE(2.0 * (double)sph_cleaning_rate_scaled(wave, SPH_R(1.5), SPH_R(7), SPH_R(4)), -64.0,
                   8.0 * EPSILON);
    CHECK_RELATIVE((double)sph_cleaning_rate_velocity(wave, SPH_R(3), SPH_R(-7)), -28.0 - 30.0,
                   8.0 * EPSILON);
    c = sph_euler_potentials(a, b); /* grad A = (0, 2, 0): B = (dA/dy, -dA/dx) */
    CHECK((double)c.x == 2.0 && (double)c.y == 0.0 && (double)c.z == 0.0);
    a.x = SPH_R(3), a.z = SPH_R(5), b.x = SPH_R(7), b.y = SPH_R(11), b.z = SPH_R(13); /* (3, 2, 5) x (7, 11, 13) */
    c = sph_euler_potentials(a, b);
    CHECK((double)c.x == 26.0 - 55.0 && (double)c.y == 35.0 - 39.0 && (double)c.z == 33.0 - 14.0);
    CHECK_RELATIVE((double)sph_viscosity_switch_rate(alpha, SPH_R(3), SPH_R(0.2), SPH_R(-4)),
                   -0.4 * 1.5 + 4.0 * 1.5, 16.0 * EPSILON);
    CHECK_RELATIVE((double)sph_viscosity_switch_rate(alpha, SPH_R(3), SPH_R(0.2), SPH_R(4)), -0.4 * 1.5,
                   16.0 * EPSILON);
    CHECK_RELATIVE(0.1 * (double)sph_resistivity_switch(SPH_R(0.2), SPH_R(3), SPH_R(4)), 0.1 * 0.15,
                   8.0 * EPSILON);
    CHECK(sph_resistivity_switch(SPH_R(0.2), SPH_R(30), SPH_R(4)) == SPH_R(1));
    CHECK(sph_resistivity_switch(SPH_R(0.2), SPH_R(30), SPH_R(0)) == SPH_R(1));
    CHECK(sph_resistivity_switch(SPH_R(0.2), SPH_R(0), SPH_R(4)) == SPH_R(0));
    CHECK(sph_resistivity_switch(SPH_R(0.2), SPH_R(0), SPH_R(0)) == SPH_R(0));
}

/* ---- I9, I10: velocity cleaning ---- */

static void test_velocity_cleaning(void)
{
    int dim;
    for (dim = 2; dim <= 3; dim++) {
        state s = random_state(dim, 0, dim);
        const double ch = 1.7;
        const sph_cleaning_wave wave = {.ch = SPH_R(ch), .h = s.c.h};
        sph_fluid f;
        double rate = 0.0, all = 0.0, p[3] = {0, 0, 0}, l = 0.0, size = 0.0;
        sph_index i;
        int k;
        memset(&f, 0, sizeof f);
        f.m = field(&s, M);
        f.rho = field(&s, RHO);
        f.p = field(&s, PSI); /* psi in the place of p */
        f.v = three(&s, VX, dim);
        CHECK(sph_fluid_rates_monaghan(KERNEL, dim, cloud_view(&s.c), f, (sph_fluid_out){.acceleration = three_out(&s, AX), .rate = s.a[DIVV]}) == 0);
        for (i = 0; i < s.c.n; i++) {
            const double m = (double)s.a[M][i], rho = (double)s.a[RHO][i], psi = (double)s.a[PSI][i], drho = (double)s.a[DIVV][i];
            const double e = m * psi * (double)sph_cleaning_rate_velocity(wave, SPH_R(psi), SPH_R(drho)) /
                             (ch * ch * rho * rho);
            rate += e;
            all += fabs(e);
            for (k = 0; k < dim; k++) {
                rate += m * (double)s.a[VX + k][i] * (double)s.a[AX + k][i];
                p[k] += m * (double)s.a[AX + k][i];
                size += fabs(m * (double)s.a[AX + k][i]);
            }
            l += m * ((double)s.c.x[i] * (double)s.a[AY][i] - (double)s.c.y[i] * (double)s.a[AX][i]);
        }
        CHECK_CLOSE(rate, 0.0, 50.0 * EPSILON * all);
        CHECK_CLOSE(fabs(p[0]) + fabs(p[1]) + fabs(p[2]) + fabs(l), 0.0, 100.0 * EPSILON * size);
        state_free(&s);
    }
}

/* a lattice disc with a free boundary, as figure 1 of the paper: the conjugate pair keeps the energy, the other one multiplies it. Explicit midpoint steps, short enough not to matter. */
static void test_boundary(void)
{
    int form;
    for (form = 0; form < 3; form += 2) {
        enum { SIDE = 24 };
        state s;
        sph_index i;
        double energy[2] = {0, 0};
        int step, k, j;
        cloud c = cloud_new(2, SIDE * SIDE);
        c.dx = 1.0 / SIDE;
        c.h = SPH_R(1.2 / SIDE);
        for (i = 0, j = 0; i < SIDE * SIDE; i++) {
            const double x = (i % SIDE + 0.5) / SIDE - 0.5, y = (i / SIDE + 0.5) / SIDE - 0.5;
            if (hypot(x, y) > 0.5) continue;
            c.x[j] = SPH_R(x);
            c.y[j++] = SPH_R(y);
        }
        c.n = j;
        s.c = c;
        s.a[0] = (sph_real *)cloud_memory((size_t)ARRAYS * (size_t)c.n, sizeof *s.a[0]);
        for (k = 1; k < ARRAYS; k++) s.a[k] = s.a[0] + k * c.n;
        for (i = 0; i < c.n; i++) {
            const double q = hypot((double)c.x[i], (double)c.y[i]) / 0.2;
            s.a[M][i] = SPH_R(c.dx * c.dx);
            s.a[RHO][i] = s.a[OMEGA][i] = SPH_R(1);
            s.a[H][i] = c.h;
            s.a[BX][i] = SPH_R(q < 1.0 ? (q * q * q * q - 1.0) * (q * q * q * q - 1.0) : 0.0);
        }
        lists(&s);
        for (step = 0; step <= 800; step++) { /* to t = 3: the wave meets the edge at 0.5 */
            const double dt = 0.15 * (double)c.h / 2.0;
            if (step == 0 || step == 800)
                for (i = 0; i < c.n; i++) energy[step > 0] += pow((double)s.a[BX][i], 2.0) + pow((double)s.a[BY][i], 2.0) + pow((double)s.a[PSI][i], 2.0);
            CHECK(clean(form == 0 ? CONJUGATE : DIFFERENCES, &s, 1.0, 0.0, 0) == 0);
            for (i = 0; i < c.n; i++) s.a[PSI][i] += SPH_R(dt) * s.a[RPSI][i]; /* Verlet: psi first, then B with the new psi */
            CHECK(clean(form == 0 ? CONJUGATE : DIFFERENCES, &s, 1.0, 0.0, 0) == 0);
            for (i = 0; i < c.n; i++) {
                s.a[BX][i] += SPH_R(dt) * s.a[RBX][i];
                s.a[BY][i] += SPH_R(dt) * s.a[RBY][i];
            }
        }
        if (form == 0) CHECK_RELATIVE(energy[1], energy[0], 0.05);
        else CHECK(!(energy[1] < 10.0 * energy[0]));
        state_free(&s);
    }
}

/* v_sig where the list has pairs beyond the support, more neighbours than a tile, and none */
static void test_signal_speed(void)
{
    state s = random_state(2, 1, 3);
    sph_index i, j, *index;
    sph_mhd m = mhd(&s, 3, 0, 0.0, 0.0, 1.0);
    sph_real *const near_only = (sph_real *)cloud_memory((size_t)s.c.n, sizeof *near_only);
    CHECK(rates(&s, m, field(&s, H)) == 0);
    for (i = 0; i < s.c.n; i++) near_only[i] = s.a[VSIG][i];
    free(s.c.index);
    index = s.c.index = (sph_index *)cloud_memory((size_t)s.c.n * (size_t)s.c.n, sizeof *index);
    for (i = 0; i < s.c.n; i++) {
        s.c.start[i] = (sph_index)(index - s.c.index);
        for (j = 0; j < s.c.n; j++)
            if (j != i) *index++ = j;
    }
    s.c.start[s.c.n] = (sph_index)(index - s.c.index);
    CHECK(rates(&s, m, field(&s, H)) == 0);
    for (i = 0; i < s.c.n; i++)
        CHECK_NEAR_RELATIVE("signal speed with a longer list", i, s.a[VSIG][i], near_only[i], 2.0 * EPSILON);
    for (i = 0; i <= s.c.n; i++) s.c.start[i] = 0;
    CHECK(rates(&s, m, field(&s, H)) == 0);
    for (i = 0; i < s.c.n; i++) {
        sph_vec B = {SPH_R(0), SPH_R(0), SPH_R(0)};
        B.x = s.a[BX][i];
        B.y = s.a[BY][i];
        B.z = s.a[BZ][i];
        CHECK_NEAR_RELATIVE("signal speed without neighbours", i, s.a[VSIG][i],
                            sph_mhd_fast_speed(s.a[CS][i], B, s.a[RHO][i], SPH_R(0)), 2.0 * EPSILON);
    }
    free(near_only);
    state_free(&s);
}

/* three components in two dimensions: where v has a third array, B and the rates need theirs, too */
static void test_components(void)
{
    state s = random_state(2, 1, 2);
    sph_mhd m = mhd(&s, 3, 1, 0.1, 1.0, 1.0);
    CHECK(rates(&s, m, field(&s, H)) == 0);
    m.field.z = sph_scalars_none();
    CHECK(rates(&s, m, field(&s, H)) == SPH_ERROR_NULL);
    state_free(&s);
}

/* one component alone that leaves the range of numbers: the whole vector is 0, and the particle counts as failed */
static void test_overflow(void)
{
    const sph_real one = SPH_R(1), large = BY_PRECISION(SPH_R(1e300), SPH_R(1e36)),
                   h = BY_PRECISION(SPH_R(1e10), SPH_R(1e3)); /* a factor that is a number, times a length that is too much */
    const sph_index start[3] = {0, 1, 2}, index[2] = {1, 0};
    sph_list list;
    int dim, axis, k;
    list.start = start;
    list.index = index;
    for (dim = 1; dim <= 3; dim++)
        for (axis = 0; axis < dim; axis++) {
            sph_real x[3][2] = {{0, 0}, {0, 0}, {0, 0}}, out[3][2] = {{7, 7}, {7, 7}, {7, 7}};
            sph_real m = h * h * h;
            sph_cloud two;
            sph_medium g;
            for (k = 1; k < dim; k++) m *= h;
            x[axis][1] = h;
            g.m = sph_scalars_same(&m);
            g.rho = g.omega = sph_scalars_same(&one);
            two = sph_cloud_of(sph_points_separate(2, x[0], x[1], x[2]), list, sph_scalars_same(&h),
                               sph_scalars_none());
            CHECK(sph_gradient_symmetric(KERNEL, dim, two, g, sph_scalars_same(&large),
                                         sph_vector_out_separate(out[0], out[1], out[2])) == 2);
            for (k = 0; k < dim; k++) CHECK((double)out[k][0] == 0.0 && (double)out[k][1] == 0.0);
        }
}

/* ---- the order of a step: rates by predicted v and u. A wave that steepens, in kick-drift-kick: the largest error of
   the energy, relative ---- */

static double energy_error(int predicted, double dt)
{
    enum { GAS = 100 };
    const sph_real m = SPH_R(1.0 / GAS), zero = SPH_R(0), one = SPH_R(1);
    cloud c = cloud_new(1, GAS);
    sph_real v[GAS], u[GAS], v_now[GAS], u_now[GAS], a[GAS], du[GAS], rate_B[GAS], h[GAS], rho[GAS], omega[GAS], reach[GAS], p[GAS], cs[GAS];
    double first = 0.0, worst = 0.0;
    sph_index i, j, pairs = 0;
    int step;
    c.index = (sph_index *)cloud_memory(GAS * 24, sizeof *c.index);
    for (i = 0; i < GAS; i++) { /* the 12 next ones on either side stay the next ones, and are beyond any support */
        c.x[i] = SPH_R((i + 0.5) / GAS);
        v[i] = v_now[i] = SPH_R(0.5 * sin(2.0 * PI * (double)c.x[i]));
        u[i] = u_now[i] = SPH_R(1.0 / (0.4 * 1.4));
        h[i] = SPH_R(1.2 / GAS);
        reach[i] = SPH_R(0.06);
        for (j = -12; j <= 12; j++)
            if (j != 0) c.index[pairs++] = (i + j + GAS) % GAS;
        c.start[i + 1] = pairs;
    }
    for (step = 0; step * dt < 0.5; step++) {
        const sph_cloud all = sph_cloud_of(sph_points_periodic(cloud_points(&c), one, zero, zero), cloud_list(&c), sph_scalars_array(h), sph_scalars_none());
        const sph_density_options options = {sph_scalars_array(reach), SPH_R(1.2), SPH_R(BY_PRECISION(1e-10, 1e-5))};
        const sph_density_out density = {.h = h, .rho = rho, .omega = omega};
        sph_mhd s = {.medium = {sph_scalars_same(&m), sph_scalars_array(rho), sph_scalars_array(omega)}, .p = sph_scalars_array(p), .u = sph_scalars_array(u_now),
                     .cs = sph_scalars_array(cs), .alpha = sph_scalars_same(&one), .alpha_B = sph_scalars_same(&zero), .beta = 2, .alpha_u = 1};
        const sph_mhd_out out = {.acceleration = sph_vector_out_separate(a, 0, 0), .rate_B = sph_vector_out_separate(rate_B, 0, 0), .rate_u = du};
        double energy = 0.0;
        s.v.x = sph_scalars_array(v_now);
        s.field.x = sph_scalars_same(&zero);
        CHECK(sph_density_adaptive(SPH_CUBIC_SPLINE, 1, all, sph_scalars_same(&m), options, density) == 0);
        for (i = 0; i < GAS; i++) {
            p[i] = SPH_R(0.4) * rho[i] * u_now[i];
            cs[i] = SPH_R(sqrt(1.4 * 0.4 * (double)u_now[i]));
        }
        CHECK(sph_mhd_rates(SPH_CUBIC_SPLINE, 1, all, s, out) == 0);
        for (i = 0; i < GAS; i++) {
            if (step > 0) { /* the second kick of the step before */
                v[i] += SPH_R(0.5 * dt) * a[i];
                u[i] += SPH_R(0.5 * dt) * du[i];
            }
            energy += ((double)u[i] + 0.5 * (double)v[i] * (double)v[i]) / GAS;
        }
        if (step == 0) first = energy;
        worst = fmax(worst, fabs(energy / first - 1.0));
        for (i = 0; i < GAS; i++) {
            v[i] += SPH_R(0.5 * dt) * a[i];
            u[i] += SPH_R(0.5 * dt) * du[i];
            c.x[i] += SPH_R(dt) * v[i];
            v_now[i] = v[i] + (predicted ? SPH_R(0.5 * dt) * a[i] : zero);
            u_now[i] = u[i] + (predicted ? SPH_R(0.5 * dt) * du[i] : zero);
        }
    }
    cloud_free(&c);
    return worst;
}
static void test_predicted(void)
{
    CHECK(energy_error(1, 4e-3) < BY_PRECISION(1e-5, 3e-5));
    CHECK(energy_error(0, 4e-3) > 1e-3);
}

int main(void)
{
    test_conjugate();
    test_energy();
    test_by_hand();
    test_heating();
    test_linear();
    test_values();
    test_velocity_cleaning();
    test_boundary();
    test_signal_speed();
    test_components();
    test_overflow();
    test_predicted();
    return check_report("test_cleaning");
}
