/* SPDX-License-Identifier: MIT */
/*
 * test_riemann.c - the Riemann solver of a weakly compressible fluid: the contact by hand, the sweep beside sums by hand, momentum, energy, and a tank at rest that stays where
 * it is only if gravity is taken out of the jump.
 */
#include "../sph.h"
#include "check.h"
#include "clouds.h"
#include "flows.h"

#include <string.h>

#define KERNEL SPH_WENDLAND_C2
#define EPSILON ((double)SPH_EPSILON)

static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }

/* ---- the contact ---- */

static sph_riemann_side side(double p, double z, double u)
{
    sph_riemann_side s;
    memset(&s, 0, sizeof s);
    s.p = SPH_R(p);
    s.z = SPH_R(z);
    s.u = SPH_R(u);
    return s;
}
static void check_star(sph_riemann_star s, double p, double u)
{
    CHECK_CLOSE((double)s.p, p, 16.0 * EPSILON * (1.0 + fabs(p)));
    CHECK_CLOSE((double)s.u, u, 16.0 * EPSILON * (1.0 + fabs(u)));
}
static void test_contact(void)
{
    const double z[2] = {1.5, 4000.0};
    const sph_real one = SPH_R(1), none = SPH_R(0);
    sph_vec g, x;
    int a;
    /* equal states stay as they are */
    check_star(sph_riemann_acoustic(side(3.0, 2.0, -0.7), side(3.0, 5.0, -0.7), one, none), 3.0, -0.7);
    /* a sound wave p' = Z_L u' in a medium at rest meets another one: p* = 2 Z_R / (Z_L + Z_R) p', u* = p* / Z_R */
    for (a = 0; a < 2; a++) {
        const double l = z[a], r = z[1 - a], wave = 0.25, through = 2.0 * r / (l + r) * wave;
        check_star(sph_riemann_acoustic(side(wave, l, wave / l), side(0.0, r, 0.0), one, none), through, through / r);
        /* the same seen from the other side */
        check_star(sph_riemann_acoustic(side(0.0, r, 0.0), side(wave, l, -wave / l), one, none), through, -through / r);
        /* without beta the velocities do not act on the pressure, and the side with the smaller Z decides it */
        check_star(sph_riemann_acoustic(side(1.0, l, 5.0), side(2.0, r, -3.0), none, none), (r * 1.0 + l * 2.0) / (l + r), (5.0 * l - 3.0 * r - 1.0) / (l + r));
    }
    /* what beta adds is told apart: half of 2 Z (U_L - U_R) / 2 */
    CHECK_CLOSE((double)sph_riemann_acoustic(side(1.0, 3.0, 0.5), side(1.0, 3.0, -0.5), SPH_R(0.5), none).viscous, 0.75, 8.0 * EPSILON);
    /* rest: the pressures of water at rest do not move the contact; x_ij points up, and so i has the smaller one */
    g.x = g.z = x.x = x.z = SPH_R(0);
    g.y = SPH_R(-9.81);
    x.y = SPH_R(0.1);
    CHECK_CLOSE((double)sph_riemann_rest(2, SPH_R(1000), g, x), -981.0, 1000.0 * EPSILON);
    check_star(sph_riemann_acoustic(side(0.0, 1e4, 0.0), side(981.0, 1e4, 0.0), one, sph_riemann_rest(2, SPH_R(1000), g, x)), 490.5, 0.0);
    /* the limiter: 0 for sides that recede, 3 times the Mach number, 1 at most. c = (2 + 4) / (1 + 2) = 2 */
    CHECK((double)sph_riemann_beta(side(0.0, 2.0, -1.0), side(0.0, 4.0, 1.0), SPH_R(1.5), SPH_R(3)) == 0.0);
    CHECK_CLOSE((double)sph_riemann_beta(side(0.0, 2.0, 0.1), side(0.0, 4.0, -0.1), SPH_R(1.5), SPH_R(3)), 0.3, 8.0 * EPSILON);
    CHECK((double)sph_riemann_beta(side(0.0, 2.0, 1.0), side(0.0, 4.0, -1.0), SPH_R(1.5), SPH_R(3)) == 1.0);
}

/* ---- a cloud with a state of two fluids ---- */

static sph_fluid_out into(const flow *f)
{
    sph_fluid_out o;
    memset(&o, 0, sizeof o);
    o.acceleration = flow_a(f);
    o.rate = f->rate;
    o.heating = f->heating;
    return o;
}
static sph_scalars lengths(const flow *f, int own) { return own ? sph_scalars_array(f->h) : cloud_h(&f->c); }
static sph_cloud view(const flow *f, int own) { return flow_cloud(f, lengths(f, own)); }
static sph_riemann_options told(double limiter, double gx, double gy, double gz)
{
    sph_riemann_options o;
    o.limiter = SPH_R(limiter);
    o.gravity.x = SPH_R(gx);
    o.gravity.y = SPH_R(gy);
    o.gravity.z = SPH_R(gz);
    return o;
}

/* ---- the sweep beside sums by hand, and what it conserves ---- */

static void test_sums(void)
{
    static const int edge[] = {0, 41, 11, 7};
    static const double limiters[] = {0.0, 0.7, -1.0};
    int dim, own, which;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (which = 0; which < 3; which++) {
                flow f = flow_of(cloud_lattice(dim, edge[dim], 1.3, 0.2, 3), 17);
                const double g[3] = {0.0, which ? -1.3 : 0.0, which ? 0.4 : 0.0};
                const double limiter = which ? limiters[which] : 3.0;
                double a_off = 0.0, rate_off = 0.0, heat_off = 0.0, a_size = 0.0, rate_size = 0.0, heat_size = 0.0, push[3] = {0.0, 0.0, 0.0}, size = 0.0, energy = 0.0, lost = 0.0,
                       heat_lost = 0.0, heated = 0.0;
                sph_index i, q;
                int k;
                CHECK(sph_fluid_rates_riemann(KERNEL, dim, view(&f, own), flow_fluid(&f), told(limiters[which], g[0], g[1], g[2]), into(&f)) == 0);
                for (i = 0; i < f.c.n; i++) {
                    double a[3] = {0.0, 0.0, 0.0}, rate = 0.0, heat = 0.0, xi[3], xj[3];
                    const double ri = (double)f.rho[i], Zi = ri * (double)f.cs[i], pi = (double)f.p[i], Vi = (double)f.m[i] / ri;
                    cloud_position(&f.c, i, xi);
                    for (q = f.c.start[i]; q < f.c.start[i + 1]; q++) {
                        const sph_index j = f.c.index[q];
                        const double rj = (double)f.rho[j], Zj = rj * (double)f.cs[j], pj = (double)f.p[j], Vj = (double)f.m[j] / rj, Z = Zi * Zj / (Zi + Zj);
                        const double hij = 0.5 * ((double)lengths(&f, own).p[own ? i : 0] + (double)lengths(&f, own).p[own ? j : 0]);
                        double e[3], r = 0.0, UL = 0.0, UR = 0.0, still = 0.0, F, beta, P, U, down = 0.0;
                        cloud_position(&f.c, j, xj);
                        for (k = 0; k < dim; k++) r += (xj[k] - xi[k]) * (xj[k] - xi[k]);
                        r = sqrt(r);
                        F = (double)sph_kernel_f(KERNEL, dim, SPH_R(r), SPH_R(hij));
                        for (k = 0; k < dim; k++) {
                            e[k] = (xj[k] - xi[k]) / r;
                            UL += (double)f.v[k][i] * e[k];
                            UR += (double)f.v[k][j] * e[k];
                            still -= 0.5 * (ri + rj) * g[k] * (xj[k] - xi[k]);
                        }
                        beta = limiter < 0.0 ? 1.0 : fmin(1.0, limiter * fmax(UL - UR, 0.0) * (ri + rj) / (Zi + Zj));
                        P = (Zj * pi + Zi * pj) / (Zi + Zj) + beta * Z * (UL - UR);
                        U = (Zi * UL + Zj * UR + pi - pj - still) / (Zi + Zj);
                        for (k = 0; k < dim; k++) {
                            const double gradient = -F * r * e[k], v = 0.5 * ((double)f.v[k][i] + (double)f.v[k][j]) + (U - 0.5 * (UL + UR)) * e[k];
                            a[k] -= 2.0 * Vi * Vj * P * gradient / (double)f.m[i];
                            rate += 2.0 * ri * Vj * ((double)f.v[k][i] - v) * gradient;
                        }
                        heat -= Vi * Vj * beta * Z * (UL - UR) * (UL - UR) * F * r / (double)f.m[i];
                        if (j < i) down = Vi * Vj * F * r;
                        heat_lost += 2.0 * down * beta * Z * (UL - UR) * (UL - UR);
                        lost += down * (2.0 * beta * Z * (UL - UR) * (UL - UR) + 2.0 * (pi - pj) * (pi - pj) / (Zi + Zj));
                    }
                    for (k = 0; k < dim; k++) {
                        a_off = worse(a_off, a[k] - (double)f.a[k][i]);
                        a_size = fmax(a_size, fabs(a[k]));
                        push[k] += (double)f.m[i] * (double)f.a[k][i];
                        size += (double)f.m[i] * fabs((double)f.a[k][i]);
                        energy += (double)f.m[i] * (double)f.a[k][i] * (double)f.v[k][i];
                    }
                    energy += Vi * pi / ri * (double)f.rate[i];
                    heated += (double)f.m[i] * (double)f.heating[i];
                    rate_off = worse(rate_off, rate - (double)f.rate[i]);
                    heat_off = worse(heat_off, heat - (double)f.heating[i]);
                    rate_size = fmax(rate_size, fabs(rate));
                    heat_size = fmax(heat_size, heat);
                    if (limiter >= 0.0) CHECK_AT("heating", i, (double)f.heating[i] >= 0.0);
                }
                CHECK(heat_size > 0.0);
                CHECK_WORST(check_words("acceleration beside sums by hand in %dD, limiter %g", dim, limiter), a_off, 200.0 * EPSILON * a_size);
                CHECK_WORST(check_words("rate of density beside sums by hand in %dD, limiter %g", dim, limiter), rate_off, 200.0 * EPSILON * rate_size);
                CHECK_WORST(check_words("heating beside sums by hand in %dD, limiter %g", dim, limiter), heat_off, 200.0 * EPSILON * heat_size);
                for (k = 0; k < dim; k++) CHECK_WORST(check_words("force on all in %dD", dim), push[k], 50.0 * EPSILON * size);
                CHECK_CLOSE(heated, -heat_lost, 200.0 * EPSILON * size);
                if (which == 0) { /* without gravity: energy is lost, by the formula of the header */
                    CHECK(energy < 0.0);
                    CHECK_CLOSE(energy, lost, 200.0 * EPSILON * size);
                }
                flow_free(&f);
            }
}

/* ---- without beta, and with equal impedances, the pressure force is that of Colagrossi & Landrini ---- */

static void test_without_beta(void)
{
    flow f = flow_of(cloud_lattice(2, 13, 1.4, 0.2, 8), 5);
    sph_real *const a = (sph_real *)cloud_memory((size_t)f.c.n, sizeof *a);
    const sph_cloud all = view(&f, 1);
    sph_fluid s = flow_fluid(&f);
    sph_fluid_out o = into(&f);
    double off = 0.0, size = 0.0;
    sph_index i;
    for (i = 0; i < f.c.n; i++) f.cs[i] = SPH_R(1) / f.rho[i];
    CHECK(sph_fluid_rates_colagrossi(KERNEL, 2, all, s, o) == 0);
    memcpy(a, f.a[0], (size_t)f.c.n * sizeof *a);
    CHECK(sph_fluid_rates_riemann(KERNEL, 2, all, s, told(1e-30, 0.0, 0.0, 0.0), o) == 0);
    for (i = 0; i < f.c.n; i++) {
        off = worse(off, (double)(a[i] - f.a[0][i]));
        size = worse(size, (double)a[i]);
    }
    CHECK_WORST("pressure force without beta", off, 50.0 * EPSILON * size);
    /* negative control: with it, it is another one */
    CHECK(sph_fluid_rates_riemann(KERNEL, 2, all, s, told(0.0, 0.0, 0.0, 0.0), o) == 0);
    for (off = 0.0, i = 0; i < f.c.n; i++) off = worse(off, (double)(a[i] - f.a[0][i]));
    CHECK(off > 0.1 * size);
    free(a);
    flow_free(&f);
}

/* ---- a fluid at rest: a hydrostatic pressure has no rate with gravity, and one without ---- */

static void test_at_rest(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        static const int edge[] = {0, 31, 11, 7};
        flow f = flow_of(cloud_lattice(dim, edge[dim], 1.3, 0.2, 12), 6);
        const double g[3] = {-2.0, 0.7, 0.3};
        double still = 0.0, moved = 0.0;
        sph_index i;
        int k;
        for (i = 0; i < f.c.n; i++) {
            double x[3], p = 0.0;
            cloud_position(&f.c, i, x);
            for (k = 0; k < dim; k++) p += g[k] * x[k];
            f.rho[i] = SPH_R(1.5);
            f.p[i] = SPH_R(1.5 * p);
            for (k = 0; k < 3; k++) f.v[k][i] = SPH_R(0);
        }
        CHECK(sph_fluid_rates_riemann(KERNEL, dim, view(&f, 1), flow_fluid(&f), told(0.0, 0.0, 0.0, 0.0), into(&f)) == 0);
        for (i = 0; i < f.c.n; i++) moved = worse(moved, (double)f.rate[i]);
        CHECK(sph_fluid_rates_riemann(KERNEL, dim, view(&f, 1), flow_fluid(&f), told(0.0, g[0], g[1], g[2]), into(&f)) == 0);
        for (i = 0; i < f.c.n; i++) {
            still = worse(still, (double)f.rate[i]);
            CHECK_NEAR("heating at rest", i, f.heating[i], 0.0, 0.0);
        }
        CHECK_WORST(check_words("rate of a fluid at rest in %dD", dim), still, 500.0 * EPSILON * moved);
        CHECK(moved > 0.1);
        flow_free(&f);
    }
}

/* How far the centre of mass of water in a tank has moved, over its depth, after t = 10 sqrt(depth / g). The tank repeats along x, and its floor is three rows of particles. The water
   starts with the pressure and the density of rest, from a lattice that is a little disturbed. */
static double tank_drift(int with_gravity)
{
    enum { ACROSS = 8, UP = 16, FLOOR = 3, WATER = ACROSS * UP, ALL = ACROSS * (UP + FLOOR) };
    const double dx = 1.0 / UP, c0 = 10.0, h = 1.6 * dx, dt = 0.25 * h / c0, width = ACROSS * dx;
    const sph_tait state = {.rho0 = SPH_R(1), .c = SPH_R(c0), .gamma = SPH_R(7)};
    const sph_real zero = SPH_R(0);
    const sph_vectors still = {sph_scalars_same(&zero), sph_scalars_same(&zero), sph_scalars_same(&zero)};
    const sph_riemann_options options = told(0.0, 0.0, with_gravity ? -1.0 : 0.0, 0.0);
    flow f = flow_of(cloud_new(2, ALL), 1);
    sph_real share[ALL], scratch[2][ALL], start[WATER];
    double drift = 0.0;
    pcg32 random;
    sph_index i, j;
    int step;
    pcg32_seed(&random, 3, 3);
    f.c.h = SPH_R(h);
    f.c.index = (sph_index *)cloud_memory(ALL * (ALL - 1), sizeof *f.c.index);
    for (i = 0; i < ALL; i++) {
        const int row = (int)i / ACROSS;
        const double jitter = i < WATER ? 0.02 * dx : 0.0;
        f.c.x[i] = SPH_R(dx * (i % ACROSS + 0.5) + jitter * cloud_symmetric(&random));
        f.c.y[i] = SPH_R(dx * (i < WATER ? row + 0.5 : UP - row - 0.5) + jitter * cloud_symmetric(&random));
        f.v[0][i] = f.v[1][i] = SPH_R(0);
        share[i] = SPH_R(i < WATER);
        f.p[i] = SPH_R(i < WATER ? 1.0 - (double)f.c.y[i] : 0.0);
        f.rho[i] = sph_density_tait(f.p[i], state);
        f.m[i] = SPH_R(dx * dx);
        f.cs[i] = SPH_R(c0);
        if (i < WATER) start[i] = f.c.y[i];
    }
    for (step = 0; step * dt < 10.0; step++) {
        const sph_points points = sph_points_periodic(cloud_points(&f.c), SPH_R(width), zero, zero);
        sph_cloud all = sph_cloud_of(points, cloud_list(&f.c), cloud_h(&f.c), sph_scalars_none()), water;
        const sph_fluid s = flow_fluid(&f);
        const sph_wall wall = {sph_scalars_array(share), s.rho, s.p, s.v, still, sph_vectors_separate(0, 0, 0), {zero, SPH_R(-1), zero}};
        const sph_wall_out front = {.p = f.p, .v = sph_vector_out_separate(f.v[0], f.v[1], 0)};
        if (step % 20 == 0) { /* lists with room for what moves in 20 steps */
            const double reach = 2.0 * h + 0.3 * dx;
            sph_index pairs = 0;
            for (i = 0; i < ALL; i++) {
                for (j = 0; j < ALL; j++)
                    if (j != i && (double)sph_length(2, sphi_separation(2, points, sphi_point(2, points, i), sphi_point(2, points, j))) < reach) f.c.index[pairs++] = j;
                f.c.start[i + 1] = pairs;
            }
        }
        all = sph_cloud_checked(2, all);
        water = sph_cloud_range(all, 0, WATER);
        CHECK(sph_wall_adami(KERNEL, 2, sph_cloud_range(all, WATER, ALL), wall, front) >= 0);
        for (i = WATER; i < ALL; i++) f.rho[i] = sph_density_tait(f.p[i], state);
        CHECK(sph_fluid_rates_riemann(KERNEL, 2, water, s, options, into(&f)) == 0);
        for (i = 0; i < WATER; i++) {
            f.v[0][i] += SPH_R(dt) * f.a[0][i];
            f.v[1][i] += SPH_R(dt * ((double)f.a[1][i] - 1.0));
        }
        CHECK(sph_fluid_rates_riemann(KERNEL, 2, water, s, options, (sph_fluid_out){.acceleration = sph_vector_out_separate(scratch[0], scratch[1], 0), .rate = f.rate}) == 0);
        for (i = 0; i < WATER; i++) {
            f.c.x[i] += SPH_R(dt) * f.v[0][i];
            f.c.y[i] += SPH_R(dt) * f.v[1][i];
            f.rho[i] += SPH_R(dt) * f.rate[i];
            f.p[i] = sph_pressure_tait(f.rho[i], state);
        }
    }
    for (i = 0; i < WATER; i++) drift += ((double)f.c.y[i] - (double)start[i]) / WATER;
    flow_free(&f);
    return drift;
}
static void test_tank(void)
{
    CHECK_CLOSE(tank_drift(1), 0.0, 1e-3);
    CHECK(fabs(tank_drift(0)) > 5e-3); /* negative control: the hydrostatic pressure diffuses */
}

int main(void)
{
    test_contact();
    test_sums();
    test_without_beta();
    test_at_rest();
    test_tank();
    return check_report("test_riemann");
}
