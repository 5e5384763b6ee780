/* SPDX-License-Identifier: MIT */
/*
 * test_gravity.c - gravity softened by the kernel: potential, force, Poisson's equation; momentum and energy of self-gravitating particles, also with an h that follows the density.
 */
#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

#define EPSILON ((double)SPH_EPSILON)

static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }
static const sph_kernel softened[] = {SPH_CUBIC_SPLINE, SPH_WENDLAND_C2, SPH_WENDLAND_C4, SPH_WENDLAND_C6};

static void test_shapes(void)
{
    int k, n;
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++) {
        int known = 0;
        for (n = 0; n < 4; n++) known |= (int)softened[n] == k;
        CHECK(sph_kernel_has_gravity((sph_kernel)k) == known);
        CHECK_RELATIVE((double)sph_gravity_shape((sph_kernel)k, SPH_R(5)), -0.2, 4.0 * EPSILON);
    }
    for (n = 0; n < 4; n++) {
        const sph_kernel kernel = softened[n];
        const double e = BY_PRECISION(1e-5, 1e-2), h = 1.7;
        double q;
        for (q = 0.05; q < 2.6; q += 0.07) {
            const double phi = (double)sph_gravity_shape(kernel, SPH_R(q)), f = (double)sph_gravity_shape_f(kernel, SPH_R(q));
            const double slope = ((double)sph_gravity_shape(kernel, SPH_R(q + e)) - (double)sph_gravity_shape(kernel, SPH_R(q - e))) / (2.0 * e);
            const double f_slope = ((double)sph_gravity_shape_f(kernel, SPH_R(q + e)) - (double)sph_gravity_shape_f(kernel, SPH_R(q - e))) / (2.0 * e);
            CHECK_CLOSE(q * f, slope, BY_PRECISION(1e-8, 2e-3));
            /* lap phi = (1/q^2) d/dq (q^3 f) = 3 f + q f' = 4 pi W */
            CHECK_CLOSE(3.0 * f + q * f_slope, 4.0 * PI * (double)sph_kernel_w(kernel, 3, SPH_R(q), SPH_R(1)), BY_PRECISION(1e-7, 5e-3));
            CHECK(phi < 0.0 && f > 0.0);
            if (q > 2.0) {
                CHECK_RELATIVE(phi, -1.0 / q, 4.0 * EPSILON);
                CHECK_RELATIVE(f, 1.0 / (q * q * q), 8.0 * EPSILON);
            }
            /* units, and dphi/dh */
            CHECK_RELATIVE((double)sph_gravity_potential(kernel, SPH_R(q * h), SPH_R(h)), phi / h, BY_PRECISION(1e-13, 1e-4));
            CHECK_RELATIVE((double)sph_gravity_force(kernel, SPH_R(q * h), SPH_R(h)), f / (h * h * h), BY_PRECISION(1e-12, 1e-4));
            if (fabs(q - 2.0) > 0.02)
                CHECK_CLOSE(
                    (double)sph_gravity_dphidh(kernel, SPH_R(q * h), SPH_R(h)),
                    ((double)sph_gravity_potential(kernel, SPH_R(q * h), SPH_R(h + e)) - (double)sph_gravity_potential(kernel, SPH_R(q * h), SPH_R(h - e))) /
                        (2.0 * e),
                    BY_PRECISION(1e-8, 2e-3));
        }
        /* continuous where the pieces meet */
        CHECK_RELATIVE((double)sph_gravity_shape(kernel, SPH_R(2.0 - 1e-6)), -0.5, BY_PRECISION(2e-6, 1e-4));
        CHECK_RELATIVE((double)sph_gravity_shape_f(kernel, SPH_R(2.0 - 1e-6)), 0.125, BY_PRECISION(1e-5, 1e-3));
        CHECK_RELATIVE((double)sph_gravity_shape(kernel, SPH_R(1.0 - 1e-6)), (double)sph_gravity_shape(kernel, SPH_R(1.0 + 1e-6)), 1e-5);
        CHECK(sphi_finite(sph_gravity_force(kernel, SPH_R(0), SPH_R(1))) && sphi_finite(sph_gravity_potential(kernel, SPH_R(0), SPH_R(1))));
    }
    CHECK_RELATIVE((double)sph_gravity_shape(SPH_CUBIC_SPLINE, SPH_R(0)), -1.4, 4.0 * EPSILON);
    CHECK_RELATIVE((double)sph_gravity_shape_f(SPH_CUBIC_SPLINE, SPH_R(0)), 4.0 / 3.0, 4.0 * EPSILON);
}

/* ---- particles: everyone is in everyone's list ---- */

typedef struct ball {
    cloud c;
    sph_real *m, *h, *rho, *omega, *zeta, *phi, *a[3], *b[3], *reach;
} ball;

static ball ball_new(sph_index n, uint64_t seed)
{
    ball s;
    pcg32 g;
    sph_index i, j;
    int k;
    s.c = cloud_new(3, n);
    s.m = (sph_real *)cloud_memory(13 * (size_t)n, sizeof *s.m);
    s.h = s.m + n;
    s.rho = s.h + n;
    s.omega = s.rho + n;
    s.zeta = s.omega + n;
    s.phi = s.zeta + n;
    s.reach = s.phi + n;
    for (k = 0; k < 3; k++) {
        s.a[k] = s.reach + (k + 1) * n;
        s.b[k] = s.reach + (k + 4) * n;
    }
    s.c.index = (sph_index *)cloud_memory((size_t)n * (size_t)n, sizeof *s.c.index);
    pcg32_seed(&g, seed, 1);
    for (i = 0; i < n; i++) {
        double p[3], r2;
        do {
            for (k = 0, r2 = 0.0; k < 3; k++) {
                p[k] = cloud_symmetric(&g);
                r2 += p[k] * p[k];
            }
        } while (r2 > 1.0);
        s.c.x[i] = SPH_R(p[0]);
        s.c.y[i] = SPH_R(p[1]);
        s.c.z[i] = SPH_R(p[2] * 0.7);
        s.m[i] = SPH_R(1.0 / (double)n * (1.0 + 0.3 * cloud_symmetric(&g)));
        s.h[i] = SPH_R(0.35 + 0.1 * cloud_symmetric(&g));
        s.reach[i] = SPH_R(20);
        s.c.start[i + 1] = s.c.start[i];
        for (j = 0; j < n; j++)
            if (j != i) s.c.index[s.c.start[i + 1]++] = j;
    }
    return s;
}
static void ball_free(ball *s)
{
    cloud_free(&s->c);
    free(s->m);
}
static sph_vector_out out_of(sph_real *const *a) { return sph_vector_out_separate(a[0], a[1], a[2]); }
static sph_cloud ball_cloud(const ball *s)
{
    return sph_cloud_of(cloud_points(&s->c), cloud_list(&s->c), sph_scalars_array(s->h), sph_scalars_none());
}
/* the potential energy; with an h that follows the density, if asked */
static double energy(sph_kernel k, ball *s, double G, int follow)
{
    const sph_cloud all = ball_cloud(s);
    const sph_scalars m = sph_scalars_array(s->m);
    const sph_density_options options = {sph_scalars_array(s->reach), SPH_R(1.2),
                                         SPH_R(BY_PRECISION(1e-13, 1e-5))};
    const sph_density_out out = {.h = s->h, .rho = s->rho, .omega = s->omega};
    double e = 0.0;
    sph_index i;
    if (follow) CHECK(sph_density_adaptive(k, 3, all, m, options, out) == 0);
    CHECK(sph_gravity_direct(k, all, m, SPH_R(G), out_of(s->a), sph_scalar_out_array(s->phi, 0)) == 0);
    for (i = 0; i < s->c.n; i++) e += 0.5 * (double)s->m[i] * (double)s->phi[i];
    return e;
}

static void test_energy(void)
{
    const double G = 0.8, e = BY_PRECISION(1e-5, 4e-3);
    int n, follow;
    for (n = 0; n < 4; n++)
        for (follow = 0; follow < 2; follow++) {
            ball s = ball_new(60, 5);
            const sph_kernel k = softened[n];
            double p[3] = {0, 0, 0}, size = 0.0, worst = 0.0, without = 0.0;
            sph_index i;
            int c;
            (void)energy(k, &s, G, follow);
            if (follow) {
                sph_medium gas;
                gas.m = sph_scalars_array(s.m);
                gas.rho = sph_scalars_array(s.rho);
                gas.omega = sph_scalars_array(s.omega);
                CHECK(sph_gravity_zeta(k, ball_cloud(&s), gas.m, gas.rho, sph_scalar_out_array(s.zeta, 0)) == 0);
                CHECK(sph_gravity_correction(k, ball_cloud(&s), gas, sph_scalars_array(s.zeta), SPH_R(G),
                                             out_of(s.b)) == 0);
            }
            for (c = 0; c < 3; c++) {
                sph_real *const plain = (sph_real *)cloud_memory((size_t)s.c.n, sizeof *plain), *const x = c == 0 ? s.c.x : c == 1 ? s.c.y : s.c.z;
                for (i = 0; i < s.c.n; i++) {
                    plain[i] = s.a[c][i];
                    p[c] += (double)s.m[i] * (double)(s.a[c][i] + s.b[c][i]);
                    size += fabs((double)s.m[i] * (double)s.a[c][i]);
                }
                for (i = 0; i < s.c.n; i += 7) {
                    const sph_real at = x[i];
                    double up, down, force;
                    x[i] = at + SPH_R(e);
                    up = energy(k, &s, G, follow);
                    x[i] = at - SPH_R(e);
                    down = energy(k, &s, G, follow);
                    x[i] = at;
                    force = -(up - down) / (2.0 * e) / (double)s.m[i];
                    worst = worse(worst, force - (double)plain[i] - (double)s.b[c][i]);
                    without = worse(without, force - (double)plain[i]);
                }
                (void)energy(k, &s, G, follow);
                free(plain);
            }
            for (c = 0; c < 3; c++)
                CHECK_WORST(check_words("force on all along %c", "xyz"[c]), p[c], 200.0 * EPSILON * size);
            CHECK_WORST(check_words("acceleration beside the slope of the energy, h %s",
                                    follow ? "follows" : "is fixed"),
                        worst, BY_PRECISION(2e-6, 5e-2));
            if (follow && !SPH_SINGLE) CHECK(without > 1e-3); /* the second part is needed */
            ball_free(&s);
        }
}

int main(void)
{
    test_shapes();
    test_energy();
    return check_report("test_gravity");
}
