/* SPDX-License-Identifier: MIT */
/*
 * test_fluid.c - weakly compressible fluid: equation of state, pressure and viscosity, conservation, density rates, XSPH, walls; and what is known of a distribution of particles.
 *
 * Kernel and dimension are run-time values here: one compiled instance of each operator serves all tests.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"
#include "flows.h"

#include <stdio.h>
#include <string.h>

#define KERNEL SPH_WENDLAND_C2
#define EPSILON ((double)SPH_EPSILON)

static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }

/* ---- a cloud with a state ---- */

static sph_fluid fluid(const flow *f, int viscosity, double alpha, double beta)
{
    sph_fluid s = flow_fluid(f);
    s.viscosity = viscosity;
    s.alpha = SPH_R(alpha);
    s.beta = SPH_R(beta);
    s.eta = SPH_R(0.1);
    return s;
}
enum { MONAGHAN, COLAGROSSI, HU_ADAMS, FORMS };
static sph_index rates(int form, const flow *f, sph_scalars h, sph_fluid s)
{
    const sph_cloud all = flow_cloud(f, h);
    const sph_vector_out a = flow_a(f);
    const int dim = f->c.dim;
    return form == MONAGHAN     ? sph_fluid_rates_monaghan(KERNEL, dim, all, s, (sph_fluid_out){.acceleration = a, .rate = f->rate, .heating = f->heating})
           : form == COLAGROSSI ? sph_fluid_rates_colagrossi(KERNEL, dim, all, s, (sph_fluid_out){.acceleration = a, .rate = f->rate, .heating = f->heating})
                                : sph_fluid_rates_hu_adams(KERNEL, dim, all, s, (sph_fluid_out){.acceleration = a, .rate = f->rate, .heating = f->heating});
}
static sph_index viscous(int form, const flow *f, sph_scalars h, sph_scalars mu)
{
    const sph_cloud all = flow_cloud(f, h);
    const sph_fluid s = fluid(f, SPH_VISCOSITY_NONE, 0.0, 0.0);
    return form ? sph_viscosity_mu_monaghan_cleary(KERNEL, f->c.dim, all, s, mu, flow_a(f))
                : sph_viscosity_mu_morris(KERNEL, f->c.dim, all, s, mu, flow_a(f));
}
static sph_conserved conserved(const flow *f, sph_real *const *v)
{
    sph_conserved q;
    const sph_vectors s = sph_vectors_separate(v[0], v[1], v[2]);
    memset(&q, 0, sizeof q);
    CHECK(sph_conserved_sums(f->c.dim, cloud_view(&f->c), sph_scalars_array(f->m), s, &q) == 0);
    return q;
}

/* ---- scalars ---- */

static void test_equation_of_state(void)
{
    static const double gammas[] = {1.0, 1.4, 7.0};
    int k;
    for (k = 0; k < 3; k++) {
        const sph_tait t = {.rho0 = SPH_R(1000), .c = SPH_R(30), .gamma = SPH_R(gammas[k]), .p0 = SPH_R(50)};
        const sph_real d = SPH_R(BY_PRECISION(1e-4, 1.0));
        double rho;
        CHECK_CLOSE((double)sph_pressure_tait(t.rho0, t), 50.0, 0.0);
        for (rho = 950.0; rho < 1060.0; rho += 10.0) {
            const sph_real r = SPH_R(rho), p = sph_pressure_tait(r, t);
            const double slope = ((double)sph_pressure_tait(r + d, t) - (double)sph_pressure_tait(r - d, t)) /
                                 (2.0 * (double)d);
            CHECK_RELATIVE((double)p, 50.0 + 1000.0 * 900.0 / gammas[k] * (pow(rho / 1000.0, gammas[k]) - 1.0), BY_PRECISION(1e-9, 1e-2) + (rho == 1000.0));
            CHECK_RELATIVE((double)sph_density_tait(p, t), rho, 100.0 * EPSILON);
            CHECK_RELATIVE(pow((double)sph_sound_speed_tait(r, t), 2.0), slope, BY_PRECISION(1e-6, 2e-3));
        }
        CHECK((double)sph_density_tait(SPH_R(-1e9), t) == 0.0);
    }
    CHECK_RELATIVE((double)sph_time_step_sound(SPH_R(0.1), SPH_R(9), SPH_R(1)), 0.0025, 4.0 * EPSILON);
    CHECK_RELATIVE((double)sph_time_step_force(SPH_R(0.1), SPH_R(10)), 0.025, 4.0 * EPSILON);
    CHECK_RELATIVE((double)sph_time_step_viscous_nu(SPH_R(0.1), SPH_R(1e-2)), 0.125, 4.0 * EPSILON);
    CHECK((double)sph_time_step_force(SPH_R(0.1), SPH_R(0)) > 1e8);
    CHECK((double)sph_time_step_viscous_nu(SPH_R(0.1), SPH_R(0)) > 1e17);
}

static void test_viscosity_pairs(void)
{
    /* h = 1, c = 2, rho = 3, r = 1, vx = -0.5: mu = -.5 / 1.01 */
    const double mu = -0.5 / 1.01;
    const sph_viscosity_terms monaghan = {.alpha = SPH_R(0.1), .beta = SPH_R(0.2), .eta = SPH_R(0.1)};
    const sph_viscosity_terms signal = {.alpha = SPH_R(0.1), .beta = SPH_R(3)};
    const sph_viscosity_terms bare = {.alpha = SPH_R(1), .beta = SPH_R(1)};
    const sph_encounter approach = {
        .vx = SPH_R(-0.5), .r = SPH_R(1), .h = SPH_R(1), .c = SPH_R(2), .rho = SPH_R(3)};
    const sph_encounter one_place = {.h = SPH_R(1), .c = SPH_R(1), .rho = SPH_R(1)};
    sph_encounter recede = approach, far = approach;
    recede.vx = SPH_R(0.5);
    CHECK_RELATIVE((double)sph_viscosity_pair_monaghan(monaghan, approach),
                   (-0.1 * 2.0 * mu + 0.2 * mu * mu) / 3.0, 8.0 * EPSILON);
    CHECK((double)sph_viscosity_pair_monaghan(monaghan, recede) == 0.0);
    CHECK_RELATIVE((double)sph_viscosity_pair_linear(monaghan, recede), -0.1 * 2.0 * 0.5 / 1.01 / 3.0,
                   8.0 * EPSILON);
    /* v_sig = 2 + 2 + 3 * .25 for w = -.25 */
    far.r = recede.r = SPH_R(2);
    CHECK_RELATIVE((double)sph_viscosity_pair_signal(signal, far), 0.05 * 4.75 * 0.25 / 3.0, 8.0 * EPSILON);
    CHECK((double)sph_viscosity_pair_signal(signal, recede) == 0.0);
    CHECK(sphi_finite(sph_viscosity_pair_monaghan(bare, one_place)));
    CHECK(sphi_finite(sph_viscosity_pair_signal(bare, one_place)));
}

/* ---- one particle by hand, with F of the toolkit and nothing else of it ---- */

static void test_by_hand(void)
{
    int dim, own, form;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++) {
            static const int side[] = {0, 21, 9, 6};
            flow f = flow_of(cloud_lattice(dim, side[dim], 1.3, 0.2, 3), 17);
            sph_real *const h = (sph_real *)cloud_memory((size_t)f.c.n, sizeof *h);
            sph_index i, q;
            double worst_a = 0.0, worst_rate = 0.0, worst_heat = 0.0, size_a = 0.0, size_rate = 0.0, size_heat = 0.0;
            for (i = 0; i < f.c.n; i++) h[i] = f.c.h * SPH_R(own ? 0.8 + 0.1 * (i % 3) : 1.0);
            for (form = 0; form < FORMS; form++) {
                const double alpha = 0.3, beta = 0.7;
                CHECK(rates(form, &f, own ? sph_scalars_array(h) : cloud_h(&f.c), fluid(&f, SPH_VISCOSITY_MONAGHAN, alpha, beta)) == 0);
                for (i = 0; i < f.c.n; i++) {
                    double a[3] = {0, 0, 0}, rate = 0.0, heat = 0.0, xi[3], xj[3];
                    int k;
                    cloud_position(&f.c, i, xi);
                    for (q = f.c.start[i]; q < f.c.start[i + 1]; q++) {
                        const sph_index j = f.c.index[q];
                        const double ri = (double)f.rho[i], rj = (double)f.rho[j], mi = (double)f.m[i], mj = (double)f.m[j], pi = (double)f.p[i],
                                     pj = (double)f.p[j];
                        const double hij = 0.5 * ((double)h[i] + (double)h[j]);
                        double r2 = 0.0, vx = 0.0, F, P, Pi = 0.0;
                        cloud_position(&f.c, j, xj);
                        for (k = 0; k < dim; k++) {
                            r2 += (xi[k] - xj[k]) * (xi[k] - xj[k]);
                            vx += ((double)f.v[k][i] - (double)f.v[k][j]) * (xi[k] - xj[k]);
                        }
                        F = (double)sph_kernel_f(KERNEL, dim, SPH_R(sqrt(r2)), SPH_R(hij));
                        if (vx < 0.0) {
                            const double mu = hij * vx / (r2 + 0.01 * hij * hij);
                            Pi = (-alpha * 0.5 * ((double)f.cs[i] + (double)f.cs[j]) * mu + beta * mu * mu) / (0.5 * (ri + rj));
                        }
                        P = form == MONAGHAN     ? pi / (ri * ri) + pj / (rj * rj)
                            : form == COLAGROSSI ? (pi + pj) / (ri * rj)
                                                 : (mi * mi / (ri * ri) * pi + mj * mj / (rj * rj) * pj) / (mi * mj);
                        for (k = 0; k < dim; k++) a[k] -= mj * (P + Pi) * F * (xi[k] - xj[k]);
                        rate += (form == MONAGHAN ? mj : ri * mj / rj) * vx * F;
                        heat += 0.5 * mj * Pi * vx * F;
                    }
                    for (k = 0; k < dim; k++) {
                        worst_a = worse(worst_a, a[k] - (double)f.a[k][i]);
                        size_a = fmax(size_a, fabs(a[k]));
                    }
                    worst_rate = worse(worst_rate, rate - (double)f.rate[i]);
                    worst_heat = worse(worst_heat, heat - (double)f.heating[i]);
                    size_rate = fmax(size_rate, fabs(rate));
                    size_heat = fmax(size_heat, fabs(heat));
                    CHECK_AT("viscous heating", i, (double)f.heating[i] >= 0.0); /* F <= 0, Pi >= 0, vx < 0 */
                }
            }
            CHECK_WORST(check_words("acceleration beside sums by hand in %dD", dim), worst_a,
                        200.0 * EPSILON * size_a);
            CHECK_WORST(check_words("rate of density beside sums by hand in %dD", dim), worst_rate,
                        200.0 * EPSILON * size_rate);
            CHECK_WORST(check_words("viscous heating beside sums by hand in %dD", dim), worst_heat,
                        200.0 * EPSILON * size_heat);
            free(h);
            flow_free(&f);
        }
}

/* ---- conservation: sum m a = 0, sum m x cross a = 0; the work of pressure is the change of internal energy ---- */

static void test_conserved_sums(void)
{
    cloud c = cloud_new(3, 2);
    flow f = flow_of(c, 1);
    sph_conserved q;
    const double x[2][3] = {{1, 2, 3}, {-4, 5, 0.5}}, v[2][3] = {{0.5, -1, 2}, {3, 1, -0.25}}, m[2] = {2, 3};
    double l[3] = {0, 0, 0}, p[3] = {0, 0, 0}, e = 0.0;
    int i, k;
    for (i = 0; i < 2; i++) {
        f.m[i] = SPH_R(m[i]);
        f.c.x[i] = SPH_R(x[i][0]);
        f.c.y[i] = SPH_R(x[i][1]);
        f.c.z[i] = SPH_R(x[i][2]);
        for (k = 0; k < 3; k++) {
            f.v[k][i] = SPH_R(v[i][k]);
            p[k] += m[i] * v[i][k];
            e += 0.5 * m[i] * v[i][k] * v[i][k];
            l[k] += m[i] * (x[i][(k + 1) % 3] * v[i][(k + 2) % 3] - x[i][(k + 2) % 3] * v[i][(k + 1) % 3]);
        }
    }
    q = conserved(&f, f.v);
    CHECK_CLOSE((double)q.mass, 5.0, 8.0 * EPSILON);
    CHECK_CLOSE((double)q.kinetic_energy, e, 64.0 * EPSILON);
    CHECK_CLOSE((double)q.momentum.x, p[0], 64.0 * EPSILON);
    CHECK_CLOSE((double)q.momentum.y, p[1], 64.0 * EPSILON);
    CHECK_CLOSE((double)q.momentum.z, p[2], 64.0 * EPSILON);
    CHECK_CLOSE((double)q.angular_momentum.x, l[0], 256.0 * EPSILON);
    CHECK_CLOSE((double)q.angular_momentum.y, l[1], 256.0 * EPSILON);
    CHECK_CLOSE((double)q.angular_momentum.z, l[2], 256.0 * EPSILON);
    flow_free(&f);
}

static void test_conservation(void)
{
    int dim, own, form, viscosity;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++) {
            static const int side[] = {0, 41, 13, 8};
            flow f = flow_of(cloud_lattice(dim, side[dim], 1.3, 0.25, 9), 23);
            sph_real *const h = (sph_real *)cloud_memory((size_t)f.c.n, sizeof *h);
            sph_index i;
            for (i = 0; i < f.c.n; i++) h[i] = f.c.h * SPH_R(1.0 - 0.3 * (i % 4) / 4.0);
            for (form = 0; form < FORMS + 2; form++)
                for (viscosity = 0; viscosity < (form < FORMS ? 4 : 1); viscosity++) {
                    const sph_scalars hs = own ? sph_scalars_array(h) : cloud_h(&f.c);
                    const char *said;
                    sph_conserved q;
                    double size = 0.0, power = 0.0, internal = 0.0;
                    int k;
                    if (form < FORMS) CHECK(rates(form, &f, hs, fluid(&f, viscosity, 0.5, 1.0)) == 0);
                    else CHECK(viscous(form - FORMS, &f, hs, sph_scalars_array(f.cs)) == 0);
                    for (i = 0; i < f.c.n; i++)
                        for (k = 0; k < dim; k++) {
                            size += (double)f.m[i] * fabs((double)f.a[k][i]);
                            power += (double)f.m[i] * (double)f.a[k][i] * (double)f.v[k][i];
                        }
                    q = conserved(&f, f.a); /* of the accelerations: force and torque */
                    CHECK(size > 0.0);
                    said = check_words("in %dD, form %d, viscosity %d: force on all", dim, form, viscosity);
                    CHECK_WORST(said, q.momentum.x, 50.0 * EPSILON * size);
                    CHECK_WORST(said, q.momentum.y, 50.0 * EPSILON * size);
                    CHECK_WORST(said, q.momentum.z, 50.0 * EPSILON * size);
                    if (form != FORMS) {
                        said = check_words("in %dD, form %d, viscosity %d: torque on all", dim, form, viscosity);
                        CHECK_WORST(said, q.angular_momentum.x, 50.0 * EPSILON * size);
                        CHECK_WORST(said, q.angular_momentum.y, 50.0 * EPSILON * size);
                        CHECK_WORST(said, q.angular_momentum.z, 50.0 * EPSILON * size);
                    } else if (dim > 1) CHECK(fabs((double)q.angular_momentum.z) > 1e-6 * size); /* Morris's viscosity does not conserve it */
                    if (form >= FORMS) CHECK(power < 0.0);                                       /* physical viscosity only takes */
                    if (form == MONAGHAN && viscosity == SPH_VISCOSITY_NONE)
                        for (i = 0; i < f.c.n; i++) internal += (double)f.m[i] * (double)f.p[i] / pow((double)f.rho[i], 2.0) * (double)f.rate[i];
                    if (form == COLAGROSSI && viscosity == SPH_VISCOSITY_NONE)
                        for (i = 0; i < f.c.n; i++) internal += (double)f.m[i] * (double)f.p[i] / pow((double)f.rho[i], 2.0) * (double)f.rate[i];
                    if (form < HU_ADAMS && viscosity == SPH_VISCOSITY_NONE)
                        CHECK_WORST(check_words("in %dD, form %d: work of pressure beside energy", dim, form),
                                    power + internal, 50.0 * EPSILON * size);
                    if (form < FORMS && viscosity == SPH_VISCOSITY_MONAGHAN) {
                        double heat = 0.0, without = 0.0;
                        for (i = 0; i < f.c.n; i++) heat += (double)f.m[i] * (double)f.heating[i];
                        CHECK(rates(form, &f, hs, fluid(&f, SPH_VISCOSITY_NONE, 0.0, 0.0)) == 0);
                        for (i = 0; i < f.c.n; i++)
                            for (k = 0; k < dim; k++) without += (double)f.m[i] * (double)f.a[k][i] * (double)f.v[k][i];
                        CHECK(heat > 0.0);
                        CHECK_CLOSE(power - without + heat, 0.0, 200.0 * EPSILON * size);
                    }
                }
            free(h);
            flow_free(&f);
        }
}

/* ---- linear fields on lattices ---- */

static void test_linear(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        static const int side[] = {0, 31, 23, 17};
        flow f = flow_of(cloud_lattice(dim, side[dim], 2.2, 0.0, 1), 1);
        const sph_index middle = f.c.n / 2;
        const sph_real mu = SPH_R(2);
        double G = 0.0, x[3], dv = pow(f.c.dx, dim);
        sph_index i, q;
        int k;
        for (q = f.c.start[middle]; q < f.c.start[middle + 1]; q++) { /* the lattice's own gradient factor, near 1 */
            double y[3], r2 = 0.0;
            cloud_position(&f.c, middle, x);
            cloud_position(&f.c, f.c.index[q], y);
            for (k = 0; k < dim; k++) r2 += (x[k] - y[k]) * (x[k] - y[k]);
            G -= dv * r2 * (double)sph_kernel_f(KERNEL, dim, SPH_R(sqrt(r2)), f.c.h) / dim;
        }
        CHECK_CLOSE(G, 1.0, 0.03);
        for (i = 0; i < f.c.n; i++) {
            cloud_position(&f.c, i, x);
            f.m[i] = SPH_R(2.0 * dv);
            f.rho[i] = SPH_R(2);
            f.p[i] = SPH_R(3.0 * x[0]);
            for (k = 0; k < dim; k++) f.v[k][i] = SPH_R((k + 1) * x[k]); /* div v = 1, 3, 6 */
        }
        for (k = 0; k < FORMS; k++) {
            const double tolerance = BY_PRECISION(1e-11, 1e-3);
            CHECK(rates(k, &f, cloud_h(&f.c), fluid(&f, SPH_VISCOSITY_NONE, 0.0, 0.0)) == 0);
            CHECK_NEAR_RELATIVE("-grad p / rho along x", middle, f.a[0][middle], -1.5 * G, tolerance);
            if (dim > 1) CHECK_NEAR("-grad p / rho along y", middle, f.a[1][middle], 0.0, tolerance);
            CHECK_NEAR_RELATIVE("-rho div v", middle, f.rate[middle],
                                -2.0 * G *
                                    (dim == 1   ? 1.0
                                     : dim == 2 ? 3.0
                                                : 6.0),
                                tolerance);
        }
        /* viscosity: v_x = y^2 (x^2 in 1D): (1/rho) mu 2; Monaghan & Cleary's form for divergence-free fields only */
        for (i = 0; i < f.c.n; i++) {
            cloud_position(&f.c, i, x);
            f.v[0][i] = SPH_R(dim > 1 ? x[1] * x[1] : x[0] * x[0]);
            f.v[1][i] = f.v[2][i] = SPH_R(0);
        }
        CHECK(viscous(0, &f, cloud_h(&f.c), sph_scalars_same(&mu)) == 0);
        CHECK_NEAR("div(mu grad v) / rho, Morris", middle, f.a[0][middle], 2.0, 0.1);
        CHECK(viscous(1, &f, cloud_h(&f.c), sph_scalars_same(&mu)) == 0);
        if (dim > 1) CHECK_NEAR("div(mu grad v) / rho, Monaghan & Cleary", middle, f.a[0][middle], 2.0, 0.1);
        flow_free(&f);
    }
}

/* a jump of density by 1000 in hydrostatic equilibrium of pressure: the forms made for it see nothing, the other one does; the number density keeps both sides */
static void test_jump(void)
{
    flow f = flow_of(cloud_lattice(2, 21, 1.5, 0.0, 1), 1);
    const sph_index middle = f.c.n / 2;
    sph_index i;
    double a[FORMS];
    int form;
    for (i = 0; i < f.c.n; i++) {
        f.rho[i] = SPH_R((double)f.c.x[i] < 0.52 ? 1000.0 : 1.0);
        f.m[i] = f.rho[i] * SPH_R(f.c.dx * f.c.dx);
        f.p[i] = SPH_R(7);
    }
    for (form = 0; form < FORMS; form++) {
        CHECK(rates(form, &f, cloud_h(&f.c), fluid(&f, SPH_VISCOSITY_NONE, 0.0, 0.0)) == 0);
        a[form] = fabs((double)f.a[0][middle + 1]); /* of the light side's first particle: 1 = that of p/h */
    }
    CHECK_CLOSE(a[COLAGROSSI], 0.0, BY_PRECISION(1e-9, 1e-2));
    CHECK_CLOSE(a[HU_ADAMS], 0.0, BY_PRECISION(1e-9, 1e-2));
    CHECK(a[MONAGHAN] > 100.0);
    CHECK(sph_density_number(KERNEL, 2, sph_cloud_range(cloud_view(&f.c), middle - 1, middle + 3), sph_scalars_array(f.m), sph_scalar_out_array(f.rate, 0)) == 0);
    CHECK_NEAR_RELATIVE("number density before the jump", middle, f.rate[middle], 1000.0, 0.01);
    CHECK_NEAR_RELATIVE("number density behind the jump", middle + 1, f.rate[middle + 1], 1.0, 0.01);
    flow_free(&f);
}

/* ---- XSPH: conserves, and takes relative motion away; rotation and translation as they are ---- */

static void test_xsph(void)
{
    flow f = flow_of(cloud_lattice(2, 15, 1.4, 0.2, 2), 4);
    const sph_fluid s = fluid(&f, SPH_VISCOSITY_NONE, 0.0, 0.0);
    sph_conserved q;
    sph_index i;
    double drop = 0.0, size = 0.0, turned = 0.0;
    int k;
    CHECK(sph_velocity_xsph(KERNEL, 2, cloud_view(&f.c), s, SPH_R(0.5), flow_a(&f)) == 0);
    q = conserved(&f, f.a);
    for (i = 0; i < f.c.n; i++)
        for (k = 0; k < 2; k++) {
            drop += (double)f.m[i] * (double)f.a[k][i] * (double)f.v[k][i];
            size += (double)f.m[i] * fabs((double)f.a[k][i]);
        }
    CHECK_CLOSE((double)q.momentum.x, 0.0, 50.0 * EPSILON * size);
    CHECK_CLOSE((double)q.momentum.y, 0.0, 50.0 * EPSILON * size);
    CHECK(drop < -0.1 * size * 0.1);
    /* moved by v + a, with v as it was: d/dt sum m x cross v = sum m (v + a) cross v; but not if v becomes v + a */
    for (i = 0; i < f.c.n; i++) turned += (double)f.m[i] * ((double)f.a[0][i] * (double)f.v[1][i] - (double)f.a[1][i] * (double)f.v[0][i]);
    CHECK_CLOSE(turned, 0.0, 50.0 * EPSILON * size);
    CHECK(fabs((double)q.angular_momentum.z) > 1e-4 * size);
    for (i = 0; i < f.c.n; i++) { /* one by one: dv_i = -epsilon sum m_j v_ij W / (mean density) */
        double by_hand[2] = {0.0, 0.0};
        sph_index p;
        for (p = f.c.start[i]; p < f.c.start[i + 1]; p++) {
            const sph_index j = f.c.index[p];
            const double r = hypot((double)(f.c.x[i] - f.c.x[j]), (double)(f.c.y[i] - f.c.y[j]));
            const double b = -0.5 * (double)f.m[j] / (0.5 * ((double)f.rho[i] + (double)f.rho[j])) * (double)sph_kernel_w(KERNEL, 2, SPH_R(r), f.c.h);
            for (k = 0; k < 2; k++) by_hand[k] += b * ((double)f.v[k][i] - (double)f.v[k][j]);
        }
        for (k = 0; k < 2; k++)
            CHECK_NEAR(check_words("XSPH along %c", "xy"[k]), i, f.a[k][i], by_hand[k],
                       BY_PRECISION(1e-13, 1e-5));
    }
    for (i = 0; i < f.c.n; i++) f.v[0][i] = SPH_R(3), f.v[1][i] = SPH_R(-2);
    CHECK(sph_velocity_xsph(KERNEL, 2, cloud_view(&f.c), s, SPH_R(0.5), flow_a(&f)) == 0);
    for (i = 0; i < f.c.n; i++) CHECK_NEAR("XSPH where all move alike", i, f.a[0][i], 0.0, 0.0);
    flow_free(&f);
}

/* ---- walls: a column at rest continues into its floor; no-slip mirrors a shear flow; free slip keeps what is along the wall ---- */

static void test_wall(void)
{
    flow f = flow_of(cloud_lattice(2, 17, 1.5, 0.0, 1), 4);
    const sph_index n = f.c.n;
    const double g = -9.81;
    sph_real *const share = (sph_real *)cloud_memory((size_t)n, sizeof *share), *const normal = (sph_real *)cloud_memory((size_t)n, sizeof *normal);
    unsigned char *const status = (unsigned char *)cloud_memory((size_t)n, 1);
    const sph_real zero = SPH_R(0);
    const sph_vectors none = sph_vectors_separate(0, 0, 0);
    const sph_wall_out out = {.p = f.rate, .v = flow_a(&f), .status = status};
    sph_vectors at_rest, up;
    sph_wall wall;
    double worst_p = 0.0, worst_v = 0.0, slip = -1e9, across = 0.0;
    const sph_index walls = 5 * 17;
    const sph_cloud targets = sph_cloud_range(cloud_view(&f.c), 3 * 17, walls);
    sph_index i;
    sph_real before[2][5 * 17];
    int slips;
    at_rest.x = at_rest.y = at_rest.z = sph_scalars_same(&zero);
    up.x = up.z = at_rest.x;
    up.y = sph_scalars_array(normal);
    wall.share = sph_scalars_array(share);
    wall.rho = sph_scalars_array(f.rho);
    wall.p = sph_scalars_array(f.p);
    wall.v = flow_v(&f);
    wall.velocity = at_rest;
    wall.normal = none;
    wall.gravity.x = wall.gravity.z = SPH_R(0);
    wall.gravity.y = SPH_R(g);
    for (i = 0; i < n; i++) { /* the five lowest rows are wall: two of them are in reach of the fluid */
        const double y = (double)f.c.y[i] - 4.5 * f.c.dx;
        share[i] = SPH_R(i >= walls);
        normal[i] = SPH_R(1);
        f.rho[i] = SPH_R(1000);
        f.p[i] = SPH_R(i >= walls ? 5000.0 + 1000.0 * g * y : -777.0);
        f.v[0][i] = SPH_R(i >= walls ? 2.0 * y : -777.0);
        f.v[1][i] = SPH_R(i >= walls ? 0.3 : -777.0);
    }
    CHECK(sph_wall_adami(KERNEL, 2, targets, wall, out) == 0);
    for (i = 3 * 17; i < walls; i++) {
        const double y = (double)f.c.y[i] - 4.5 * f.c.dx;
        if ((double)f.c.x[i] < 0.3 || (double)f.c.x[i] > 0.7) continue;
        worst_p = worse(worst_p, (double)f.rate[i] - (5000.0 + 1000.0 * g * y)); /* linear: exact */
        if (i / 17 == 4) worst_v = worse(worst_v, (double)f.a[0][i] + (double)f.v[0][walls + i % 17] * 1.0);
        across = worse(across, (double)f.a[1][i] + 0.3);
    }
    CHECK_WORST("pressure of the wall", worst_p, BY_PRECISION(1e-9, 1e-1));
    CHECK_WORST("velocity of the wall along its normal", across, BY_PRECISION(1e-12, 1e-5));
    CHECK(worst_v < 0.15 && worst_v > 0.0); /* the mean over the support is farther from the wall than the mirror image */
    wall.normal = up;
    CHECK(sph_wall_adami(KERNEL, 2, targets, wall, out) == 0);
    for (i = 4 * 17; i < walls; i++) {
        slip = fmax(slip, -(double)f.a[0][i]); /* the same direction as the fluid's */
        across = worse(across, (double)f.a[1][i] + 0.3);
    }
    CHECK(slip < 0.0);
    CHECK_WORST("velocity of the slipping wall along its normal", across, BY_PRECISION(1e-12, 1e-5));
    for (slips = 0; slips < 2; slips++) { /* seen by one who moves, everything moves */
        const sph_real u[2] = {SPH_R(0.7), SPH_R(-0.4)};
        double worst = 0.0;
        int k;
        wall.normal = slips ? up : none;
        wall.velocity = at_rest;
        CHECK(sph_wall_adami(KERNEL, 2, targets, wall, out) == 0);
        for (i = 0; i < n; i++)
            for (k = 0; k < 2; k++) {
                f.v[k][i] += u[k];
                if (i >= 3 * 17 && i < walls) before[k][i] = f.a[k][i];
            }
        wall.velocity.x = sph_scalars_same(&u[0]);
        wall.velocity.y = sph_scalars_same(&u[1]);
        CHECK(sph_wall_adami(KERNEL, 2, targets, wall, out) == 0);
        for (i = 3 * 17; i < walls; i++)
            for (k = 0; k < 2; k++) worst = worse(worst, (double)f.a[k][i] - (double)before[k][i] - (double)u[k]);
        CHECK_WORST(slips ? "velocity of a slipping wall, seen in motion"
                          : "velocity of a wall, seen in motion",
                    worst, BY_PRECISION(1e-12, 1e-5));
    }
    wall.normal = none;
    wall.velocity = at_rest;
    CHECK(sph_wall_adami(KERNEL, 2, sph_cloud_range(targets, 0, 17), wall, out) == 17);
    CHECK(status[3] == SPH_TOO_FEW && f.rate[3] == SPH_R(0) && f.a[0][3] == SPH_R(0));
    free(share);
    free(normal);
    free(status);
    flow_free(&f);
}

/* ---- distributions ---- */

static void test_distribution(void)
{
    enum { BINS = 30 };
    const double dx = 0.05;
    cloud c = cloud_new(2, 24 * 20);
    sph_real *const out = (sph_real *)cloud_memory((size_t)c.n, sizeof *out), g[BINS];
    unsigned char *const status = (unsigned char *)cloud_memory((size_t)c.n, 1);
    sph_points x;
    const sph_real reach = SPH_R(2.6 * dx);
    const sph_scalars R = sph_scalars_same(&reach);
    const size_t size = sph_grid_workspace(2, c.n);
    void *const work = cloud_memory(size, 1);
    const sph_scalar_out each = sph_scalar_out_array(out, status);
    sph_grid grid;
    sph_cloud all;
    sph_index i;
    double pairs = 0.0;
    for (i = 0; i < c.n; i++) { /* hexagons in a periodic box */
        c.x[i] = SPH_R(dx * (i % 24 + 0.5 * (i / 24 % 2)));
        c.y[i] = SPH_R(dx * sqrt(0.75) * (i / 24));
    }
    x = sph_points_periodic(cloud_points(&c), SPH_R(24 * dx), SPH_R(20 * dx * sqrt(0.75)), SPH_R(0));
    CHECK(sph_grid_build(2, x, R, work, size, &grid) == 0);
    CHECK(sph_grid_count(2, &grid, sph_query_of(x, SPH_GATHER, R, 0), c.start, &c.pairs) == 0);
    c.index = (sph_index *)cloud_memory((size_t)c.pairs, sizeof *c.index);
    CHECK(sph_grid_lists(2, &grid, sph_query_of(x, SPH_GATHER, R, 0), c.start, c.index, c.pairs, &c.pairs) == 0);
    all = sph_cloud_of(x, cloud_list(&c), sph_scalars_none(), sph_scalars_none());
    CHECK(sph_nearest_distance(2, all, x, each) == 0);
    for (i = 0; i < c.n; i++)
        CHECK_NEAR("distance to the nearest / dx", i, (double)out[i] / dx, 1.0, BY_PRECISION(1e-12, 1e-4));
    CHECK(sph_hexatic_order(all, each) == 0);
    for (i = 0; i < c.n; i++) CHECK_NEAR("hexatic order", i, out[i], 1.0, BY_PRECISION(1e-9, 1e-3));
    CHECK(sph_radial_distribution(2, all, reach, SPH_R(1.0 / (dx * dx * sqrt(0.75))), BINS, g) == 0);
    for (i = 0; i < BINS; i++) pairs += (double)g[i] * PI * (2.0 * i + 1.0) * pow((double)reach / BINS, 2.0) / (dx * dx * sqrt(0.75));
    CHECK_RELATIVE(pairs, (double)c.pairs / (double)c.n, 1e-5); /* what is counted is what is there */
    CHECK((double)g[11] > 2.0 || (double)g[10] > 2.0 || (double)g[12] > 2.0);
    CHECK((double)g[5] == 0.0);
    /* a square lattice has no hexatic order; two particles in one place */
    for (i = 0; i < c.n; i++) c.x[i] = SPH_R(dx * (i % 24)), c.y[i] = SPH_R(dx * (i / 24));
    c.x[30] = c.x[31];
    x = cloud_points(&c);
    cloud_neighbors(&c, (double)reach);
    all = sph_cloud_of(x, cloud_list(&c), sph_scalars_none(), sph_scalars_none());
    CHECK(sph_hexatic_order(all, each) == 0);
    CHECK((double)out[10 * 24 + 12] < 0.9);
    CHECK(sph_coincident_count(2, all, SPH_R(1e-12)) == 2);
    {
        sph_real *const moved = (sph_real *)cloud_memory(2 * (size_t)c.n, sizeof *moved);
        const sph_vector_out to = sph_vector_out_separate(moved, moved + c.n, 0);
        CHECK(sph_coincident_separate(2, all, SPH_R(1e-12), SPH_R(0.1 * dx), to) == 2);
        CHECK(hypot((double)(to.x[30] - to.x[31]), (double)(to.y[30] - to.y[31])) > 0.05 * dx);
        CHECK_CLOSE(hypot((double)(to.x[30] - c.x[30]), (double)(to.y[30] - c.y[30])), 0.1 * dx, 1e-6);
        for (i = 0; i < c.n; i++)
            if (i != 30 && i != 31) CHECK_AT("not to be moved", i, to.x[i] == c.x[i] && to.y[i] == c.y[i]);
        free(moved);
    }
    /* probes, and nobody in reach */
    {
        const sph_real px[2] = {SPH_R(0.5 * 0.05), SPH_R(50)}, py[2] = {SPH_R(0.5 * 0.05), SPH_R(0)};
        const sph_index start[3] = {0, 3, 3}, index[3] = {0, 1, 24};
        const sph_list l = {start, index};
        const sph_cloud probes =
            sph_cloud_of(sph_points_separate(2, px, py, 0), l, sph_scalars_none(), sph_scalars_none());
        CHECK(sph_nearest_distance(2, probes, x, each) == 1);
        CHECK_RELATIVE((double)out[0], sqrt(0.5) * dx, 1e-5);
        CHECK(status[1] == SPH_TOO_FEW && out[1] == SPH_R(0));
    }
    free(work);
    free(out);
    free(status);
    cloud_free(&c);
}

/* the hexatic order again, with angles; and coincident particles in one and three dimensions */
static void test_hexatic_and_separation(void)
{
    cloud c = cloud_lattice(2, 15, 1.5, 0.3, 4);
    sph_real *const out = (sph_real *)cloud_memory((size_t)c.n, sizeof *out);
    sph_index i, p;
    int dim;
    CHECK(sph_hexatic_order(cloud_view(&c), sph_scalar_out_array(out, 0)) == 0);
    for (i = 0; i < c.n; i++) {
        double r[6] = {9, 9, 9, 9, 9, 9}, theta[6] = {0}, re = 0.0, im = 0.0;
        int k;
        for (p = c.start[i]; p < c.start[i + 1]; p++) {
            const double x = (double)(c.x[c.index[p]] - c.x[i]), y = (double)(c.y[c.index[p]] - c.y[i]);
            if (hypot(x, y) >= r[5]) continue;
            for (k = 5; k > 0 && r[k - 1] > hypot(x, y); k--) {
                r[k] = r[k - 1];
                theta[k] = theta[k - 1];
            }
            r[k] = hypot(x, y);
            theta[k] = atan2(y, x);
        }
        for (k = 0; k < 6; k++) {
            re += cos(6.0 * theta[k]) / 6.0;
            im += sin(6.0 * theta[k]) / 6.0;
        }
        CHECK_NEAR("hexatic order", i, out[i], hypot(re, im), 200.0 * EPSILON);
    }
    free(out);
    cloud_free(&c);
    for (dim = 1; dim <= 3; dim++) {
        sph_real *moved;
        sph_vector_out to;
        double d2;
        c = cloud_lattice(dim, 7, 1.5, 0.1, 4);
        c.x[5] = c.x[4];
        c.y[5] = c.y[4];
        c.z[5] = c.z[4];
        cloud_neighbors(&c, 2.0 * (double)c.h);
        moved = (sph_real *)cloud_memory(3 * (size_t)c.n, sizeof *moved);
        to = sph_vector_out_separate(moved, moved + c.n, moved + 2 * c.n);
        CHECK(sph_coincident_separate(dim, cloud_view(&c), SPH_R(0), SPH_R(0.01), to) == 2);
        for (i = 4; i < 6; i++) {
            d2 = pow((double)(to.x[i] - c.x[i]), 2.0) + pow((double)(to.y[i] - c.y[i]), 2.0) + pow((double)(to.z[i] - c.z[i]), 2.0);
            CHECK_NEAR_RELATIVE("step away", i, sqrt(d2), 0.01, 1e-4);
        }
        d2 = pow((double)(to.x[5] - to.x[4]), 2.0) + pow((double)(to.y[5] - to.y[4]), 2.0) + pow((double)(to.z[5] - to.z[4]), 2.0);
        CHECK(sqrt(d2) > 0.005);
        for (i = 0; i < c.n; i++)
            if (i != 4 && i != 5)
                CHECK_AT("not to be moved", i,
                         to.x[i] == c.x[i] && (dim < 2 || to.y[i] == c.y[i]) && (dim < 3 || to.z[i] == c.z[i]));
        free(moved);
        cloud_free(&c);
    }
}

/* coincident particles: no force by any viscosity, no NaN */
static void test_coincident(void)
{
    flow f = flow_of(cloud_lattice(2, 9, 1.4, 0.2, 2), 4);
    const sph_real one = SPH_R(1);
    sph_index i;
    int viscosity, form;
    f.c.x[30] = f.c.x[31];
    f.c.y[30] = f.c.y[31];
    cloud_neighbors(&f.c, 2.05 * (double)f.c.h);
    for (viscosity = SPH_VISCOSITY_NONE; viscosity <= SPH_VISCOSITY_SIGNAL; viscosity++) {
        CHECK(rates(MONAGHAN, &f, cloud_h(&f.c), fluid(&f, viscosity, 1.0, 3.0)) == 0);
        for (i = 0; i < f.c.n; i++)
            CHECK_AT(check_words("a coincident pair, viscosity %d", viscosity), i,
                     sphi_finite(f.a[0][i]) && sphi_finite(f.a[1][i]) && sphi_finite(f.rate[i]) &&
                         sphi_finite(f.heating[i]));
    }
    flow_free(&f);
    f = flow_of(cloud_new(1, 2), 4); /* too near for a direction: no physical viscosity either, not even without softening */
    f.c.h = one;
    f.c.index = (sph_index *)cloud_memory(2, sizeof *f.c.index);
    for (i = 0; i < 2; i++) {
        f.c.x[i] = SPH_R(i * 1e-13);
        f.m[i] = f.rho[i] = one;
        f.v[0][i] = SPH_R(i);
        f.c.start[i + 1] = i + 1;
        f.c.index[i] = 1 - i;
    }
    for (form = 0; form < 2; form++) {
        sph_fluid s = fluid(&f, SPH_VISCOSITY_NONE, 0.0, 0.0);
        s.eta = SPH_R(-1);
        CHECK((form ? sph_viscosity_mu_monaghan_cleary(KERNEL, 1, flow_cloud(&f, cloud_h(&f.c)), s, sph_scalars_same(&one), flow_a(&f))
                    : sph_viscosity_mu_morris(KERNEL, 1, flow_cloud(&f, cloud_h(&f.c)), s, sph_scalars_same(&one), flow_a(&f))) == 0);
        for (i = 0; i < 2; i++) CHECK_NEAR(check_words("physical viscosity of a coincident pair, form %d", form), i, f.a[0][i], 0.0, 0.0);
    }
    flow_free(&f);
}

/* ---- physical viscosity of a shear wave: the table of examples/OPERATORS.md, row by row ---- */

/* SIDE x SIDE particles in a periodic box, dx^2 the area of each. On the hexagonal lattice rows are nearer. */
enum { SIDE = 40 };
static flow periodic_lattice(int hexagonal, double h_over_dx, double jitter, sph_kernel k, double box[2])
{
    flow f = flow_of(cloud_new(2, SIDE * SIDE), 1);
    const double dx = 0.1, sx = dx * (hexagonal ? sqrt(2.0 / sqrt(3.0)) : 1.0), sy = dx * dx / sx;
    pcg32 g;
    sph_points x;
    sph_grid grid;
    sph_real reach;
    const size_t size = sph_grid_workspace(2, f.c.n);
    void *const work = cloud_memory(size, 1);
    sph_index i;
    pcg32_seed(&g, 8, 5);
    for (i = 0; i < f.c.n; i++) {
        const int row = i / SIDE;
        f.c.x[i] = SPH_R(sx * (i % SIDE + (hexagonal ? 0.5 * (row % 2) : 0.0)) + jitter * dx * cloud_symmetric(&g));
        f.c.y[i] = SPH_R(sy * row + jitter * dx * cloud_symmetric(&g));
        f.m[i] = SPH_R(dx * dx);
        f.rho[i] = SPH_R(1);
    }
    box[0] = SIDE * sx;
    box[1] = SIDE * sy;
    f.c.h = SPH_R(h_over_dx * dx);
    reach = sph_kernel_support(k, f.c.h);
    x = sph_points_periodic(cloud_points(&f.c), SPH_R(box[0]), SPH_R(box[1]), SPH_R(0));
    CHECK(sph_grid_build(2, x, sph_scalars_same(&reach), work, size, &grid) == 0);
    CHECK(sph_grid_count(2, &grid, sph_query_of(x, SPH_GATHER, sph_scalars_same(&reach), 0), f.c.start, &f.c.pairs) == 0);
    f.c.index = (sph_index *)cloud_memory((size_t)f.c.pairs, sizeof *f.c.index);
    CHECK(sph_grid_lists(2, &grid, sph_query_of(x, SPH_GATHER, sph_scalars_same(&reach), 0), f.c.start, f.c.index, f.c.pairs, &f.c.pairs) == 0);
    free(work);
    return f;
}
/* The viscosity that damps the wave v = t sin(k . x), over the given one. t is at right angles to k (a shear), or
   along k (a compression), which goes once around the box along x, or along both axes. form 0: Morris, 1: Monaghan &
   Cleary, 2: Espanol & Revenga with the bulk viscosity 0.5. */
static double wave_viscosity(const flow *f, sph_kernel kernel, const double box[2], int form, int diagonal, int compression)
{
    const double kx = 2.0 * PI / box[0], ky = diagonal ? 2.0 * PI / box[1] : 0.0, k = hypot(kx, ky);
    const sph_real mu = SPH_R(1), zeta = SPH_R(0.5);
    const sph_shear_bulk both = {sph_scalars_same(&mu), sph_scalars_same(&zeta)};
    const sph_cloud all = sph_cloud_of(sph_points_periodic(cloud_points(&f->c), SPH_R(box[0]), SPH_R(box[1]), SPH_R(0)),
                                       cloud_list(&f->c), cloud_h(&f->c), sph_scalars_none());
    const sph_fluid s = fluid(f, SPH_VISCOSITY_NONE, 0.0, 0.0);
    double loss = 0.0, size = 0.0;
    sph_index i;
    for (i = 0; i < f->c.n; i++) {
        const double wave = sin(kx * (double)f->c.x[i] + ky * (double)f->c.y[i]);
        f->v[0][i] = SPH_R((compression ? kx : -ky) / k * wave);
        f->v[1][i] = SPH_R((compression ? ky : kx) / k * wave);
    }
    CHECK((form == 2   ? sph_viscosity_mu_espanol_revenga(kernel, 2, all, s, both, flow_a(f))
           : form == 1 ? sph_viscosity_mu_monaghan_cleary(kernel, 2, all, s, sph_scalars_same(&mu), flow_a(f))
                       : sph_viscosity_mu_morris(kernel, 2, all, s, sph_scalars_same(&mu), flow_a(f))) == 0);
    for (i = 0; i < f->c.n; i++) {
        loss -= (double)f->a[0][i] * (double)f->v[0][i] + (double)f->a[1][i] * (double)f->v[1][i];
        size += (double)f->v[0][i] * (double)f->v[0][i] + (double)f->v[1][i] * (double)f->v[1][i];
    }
    return loss / (size * k * k);
}
static double shear_viscosity(const flow *f, sph_kernel kernel, const double box[2], int form, int diagonal)
{
    return wave_viscosity(f, kernel, box, form, diagonal, 0);
}
/* What sph_time_step_viscous_nu says of compressions: 1, 3, and in 2D 1 + zeta / mu times the shear viscosity. */
static void test_compression_waves(void)
{
    static const double more[3] = {1.0, 3.0, 1.5};
    double box[2];
    flow f = periodic_lattice(1, 1.3, 0.0, SPH_WENDLAND_C2, box); /* hexagonal: no direction is another */
    int form, diagonal;
    for (form = 0; form < 3; form++)
        for (diagonal = 0; diagonal < 2; diagonal++)
            CHECK_RELATIVE(wave_viscosity(&f, SPH_WENDLAND_C2, box, form, diagonal, 1),
                           more[form] * wave_viscosity(&f, SPH_WENDLAND_C2, box, form, diagonal, 0), 0.01);
    flow_free(&f);
}
static void test_shear_waves(void)
{
    FILE *page = fopen("examples/OPERATORS.md", "r");
    char line[400], kernel[40], lattice[40];
    double jitter, h_over_dx, printed[4];
    int rows = 0;
    CHECK(page != 0);
    while (page && fgets(line, sizeof line, page)) {
        sph_kernel k;
        double box[2];
        flow f;
        int c;
        if (sscanf(line, "| %39[a-z0-9-] | %39[a-z] | %lf | %lf | %lf | %lf | %lf | %lf |", kernel, lattice, &jitter,
                   &h_over_dx, &printed[0], &printed[1], &printed[2], &printed[3]) != 8)
            continue;
        rows++;
        k = (sph_kernel)sph_kernel_from_name(kernel);
        f = periodic_lattice(strcmp(lattice, "hexagonal") == 0, h_over_dx, jitter, k, box);
        for (c = 0; c < 4; c++)
            CHECK_CLOSE(shear_viscosity(&f, k, box, c / 2, c % 2), printed[c], BY_PRECISION(0.00501, 0.0055));
        flow_free(&f);
    }
    if (page) fclose(page);
    CHECK(rows >= 12);
    page = fopen("sph_ops.h", "r"); /* what the header says of the cubic spline at its own h */
    while (page && fgets(line, sizeof line, page))
        if (sscanf(line, " %lf mu along an axis and %lf mu along the diagonal", &printed[0], &printed[1]) == 2) {
            double box[2];
            flow f = periodic_lattice(0, (double)sph_kernel_h_over_dx(SPH_CUBIC_SPLINE), 0.0, SPH_CUBIC_SPLINE, box);
            int c;
            for (c = 0; c < 2; c++)
                CHECK_CLOSE(shear_viscosity(&f, SPH_CUBIC_SPLINE, box, 1, c), printed[c], BY_PRECISION(0.00501, 0.0055));
            flow_free(&f);
            rows = -1;
        }
    if (page) fclose(page);
    CHECK(rows == -1);
}

/* ---- the order of a step: the density by the new velocities. A column of water at rest on a wall: its largest speed
   in the second half of the run, over sqrt(g height). ---- */

static double column_speed(int by_new_velocities)
{
    enum { WATER = 20, WALL = 2, ALL = WATER + WALL };
    const double dx = 1.0 / WATER, dt = 0.25 * 1.3 * dx / 20.0;
    const sph_tait state = {.rho0 = SPH_R(1), .c = SPH_R(20), .gamma = SPH_R(7)};
    const sph_real zero = SPH_R(0), one = SPH_R(1), c = state.c;
    flow f = flow_of(cloud_new(1, ALL), 1);
    sph_real share[ALL], p[ALL], v[ALL];
    double fastest = 0.0;
    sph_index i, pairs = 0, j;
    int step;
    f.c.h = SPH_R(1.3 * dx);
    f.c.index = (sph_index *)cloud_memory(ALL * (ALL - 1), sizeof *f.c.index);
    for (i = 0; i < ALL; i++) { /* the water from below, then the wall; everyone is in the list of everyone */
        f.c.x[i] = SPH_R(dx * (i < WATER ? i + 0.5 : WATER - i - 0.5));
        f.v[0][i] = SPH_R(0);
        share[i] = SPH_R(i < WATER);
        f.p[i] = SPH_R(i < WATER ? 1.0 - (double)f.c.x[i] : 0.0);
        f.rho[i] = sph_density_tait(f.p[i], state);
        f.m[i] = SPH_R(dx);
        for (j = 0; j < ALL; j++)
            if (j != i) f.c.index[pairs++] = j;
        f.c.start[i + 1] = pairs;
    }
    for (step = 0; step < 4000; step++) { /* to t = 3.25 sqrt(height / g) */
        const sph_cloud all = flow_cloud(&f, cloud_h(&f.c));
        const sph_medium g = {sph_scalars_array(f.m), sph_scalars_array(f.rho), sph_scalars_same(&one)};
        const sph_vectors none = sph_vectors_separate(0, 0, 0);
        sph_fluid s = fluid(&f, SPH_VISCOSITY_MONAGHAN, 0.05, 0.0);
        sph_wall wall = {sph_scalars_array(share), s.rho, s.p, s.v, {sph_scalars_same(&zero), none.y, none.z}, none, {SPH_R(-1), 0, 0}};
        const sph_wall_out out = {.p = p, .v = sph_vector_out_separate(v, 0, 0)};
        s.c = sph_scalars_same(&c);
        if (step == 2000) fastest = 0.0;
        CHECK(sph_wall_adami(KERNEL, 1, sph_cloud_range(all, WATER, ALL), wall, out) == 0);
        for (i = WATER; i < ALL; i++) f.rho[i] = sph_density_tait(f.p[i] = p[i], state);
        if (!by_new_velocities)
            CHECK(sph_divergence_difference(KERNEL, 1, sph_cloud_range(all, 0, WATER), g, s.v, sph_scalar_out_array(f.rate, 0)) == 0);
        CHECK(sph_fluid_rates_monaghan(KERNEL, 1, sph_cloud_range(all, 0, WATER), s, (sph_fluid_out){.acceleration = flow_a(&f)}) == 0);
        for (i = 0; i < WATER; i++) f.v[0][i] += SPH_R(dt * ((double)f.a[0][i] - 1.0));
        if (by_new_velocities)
            CHECK(sph_divergence_difference(KERNEL, 1, sph_cloud_range(all, 0, WATER), g, s.v, sph_scalar_out_array(f.rate, 0)) == 0);
        for (i = 0; i < WATER; i++) {
            f.c.x[i] += SPH_R(dt) * f.v[0][i];
            f.rho[i] -= SPH_R(dt) * f.rho[i] * f.rate[i];
            f.p[i] = sph_pressure_tait(f.rho[i], state);
            fastest = worse(fastest, (double)f.v[0][i]);
        }
        if (!(fabs(fastest) < 2.0)) break; /* it boils */
    }
    flow_free(&f);
    return fabs(fastest);
}
static void test_order_of_a_step(void)
{
    CHECK(column_speed(1) < 0.002);
    CHECK(!(column_speed(0) < 2.0));
}

int main(void)
{
    test_equation_of_state();
    test_viscosity_pairs();
    test_by_hand();
    test_conserved_sums();
    test_conservation();
    test_linear();
    test_shear_waves();
    test_compression_waves();
    test_order_of_a_step();
    test_jump();
    test_xsph();
    test_wall();
    test_distribution();
    test_hexatic_and_separation();
    test_coincident();
    return check_report("test_fluid");
}
