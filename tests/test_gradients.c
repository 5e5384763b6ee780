/* SPDX-License-Identifier: MIT */
/*
 * test_gradients.c - Shepard sums and interpolation, first derivatives, two-point Laplacians; and that every way to hand over the same numbers gives the same answer.
 */
#if defined(SPH_SINGLE) && SPH_SINGLE /* forced inline in double only: it is what takes the time to compile */
#include "one_copy.h"
#endif
#include "../examples/papers/laplacian_kernel.h"
#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

#define KERNEL SPH_WENDLAND_C4_1D
#define OTHER SPH_CUBIC_SPLINE
#define EPSILON ((double)SPH_EPSILON)

/* |a| if it is larger than m; a NaN is larger than all */
static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }

/* ---- the operators, one instance of each for a dimension ---- */

typedef struct views {
    sph_cloud cloud;
    sph_scalars f;
} views;

static views views_of(const cloud *c)
{
    views v;
    v.cloud = cloud_view(c);
    v.f = cloud_f(c);
    return v;
}

static sph_index difference(int dim, const views *v, sph_real *const *g)
{
    const sph_vector_out out = sph_vector_out_separate(g[0], dim > 1 ? g[1] : 0, dim > 2 ? g[2] : 0);
    return dim == 1   ? sph_gradient_difference(KERNEL, 1, v->cloud, v->f, out)
           : dim == 2 ? sph_gradient_difference(KERNEL, 2, v->cloud, v->f, out)
                      : sph_gradient_difference(KERNEL, 3, v->cloud, v->f, out);
}
static sph_index corrected(int dim, const views *v, sph_real *const *g, sph_real *conditioning,
                           unsigned char *status)
{
    const sph_derivatives_out out = {.gx = g[0],
                                    .gy = dim > 1 ? g[1] : 0,
                                    .gz = dim > 2 ? g[2] : 0,
                                    .conditioning = conditioning,
                                    .status = status};
    return dim == 1   ? sph_gradient_cspm(KERNEL, 1, v->cloud, v->f, out)
           : dim == 2 ? sph_gradient_cspm(KERNEL, 2, v->cloud, v->f, out)
                      : sph_gradient_cspm(KERNEL, 3, v->cloud, v->f, out);
}
static sph_index gamma_sum(int dim, const views *v, sph_real *out)
{
    return dim == 1   ? sph_shepard_sum(KERNEL, 1, v->cloud, sph_scalar_out_array(out, 0))
           : dim == 2 ? sph_shepard_sum(KERNEL, 2, v->cloud, sph_scalar_out_array(out, 0))
                      : sph_shepard_sum(KERNEL, 3, v->cloud, sph_scalar_out_array(out, 0));
}
static sph_index interpolate(int dim, const views *v, sph_real *out, unsigned char *status)
{
    const sph_scalar_out to = sph_scalar_out_array(out, status);
    return dim == 1   ? sph_interpolate_shepard(KERNEL, 1, v->cloud, v->f, to)
           : dim == 2 ? sph_interpolate_shepard(KERNEL, 2, v->cloud, v->f, to)
                      : sph_interpolate_shepard(KERNEL, 3, v->cloud, v->f, to);
}
static sph_index brookshaw(int dim, const views *v, sph_real *out)
{
    return dim == 1   ? sph_laplacian_brookshaw(KERNEL, 1, v->cloud, v->f, sph_scalar_out_array(out, 0))
           : dim == 2 ? sph_laplacian_brookshaw(KERNEL, 2, v->cloud, v->f, sph_scalar_out_array(out, 0))
                      : sph_laplacian_brookshaw(KERNEL, 3, v->cloud, v->f, sph_scalar_out_array(out, 0));
}
static void kernel_laplacian(int dim, const views *v, sph_real *out)
{
    if (dim == 1) laplacian_kernel(KERNEL, 1, v->cloud, v->f, out);
    else if (dim == 2) laplacian_kernel(KERNEL, 2, v->cloud, v->f, out);
    else laplacian_kernel(KERNEL, 3, v->cloud, v->f, out);
}

/* three components, each of n numbers, that start as NaN */
typedef struct vectors {
    sph_real *p[3];
} vectors;
static vectors vectors_new(sph_index n)
{
    vectors g;
    size_t i;
    g.p[0] = (sph_real *)cloud_memory(3 * (size_t)n, sizeof(sph_real));
    g.p[1] = g.p[0] + n;
    g.p[2] = g.p[1] + n;
    for (i = 0; i < 3 * (size_t)n; i++) g.p[0][i] = SPH_R(NAN);
    return g;
}

/* Is the whole support inside of the unit box? */
static int deep(const cloud *c, sph_index i)
{
    double p[3];
    int a;
    cloud_position(c, i, p);
    for (a = 0; a < c->dim; a++)
        if (p[a] < 2.0 * (double)c->h || p[a] > 1.0 - 2.0 * (double)c->h) return 0;
    return 1;
}

/* ---- interpolation ---- */

static void test_shepard_sum(void)
{
    static const int side[] = {0, 201, 25, 11};
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.0, 1);
        const views v = views_of(&c);
        sph_real *const out = (sph_real *)cloud_memory((size_t)c.n, sizeof *out);
        sph_index i, inside = 0;
        CHECK(gamma_sum(dim, &v, out) == 0);
        for (i = 0; i < c.n; i++) {
            /* half the volumes at a wall: the trapezoidal rule, so that symmetry gives 1 / 2 there, 1 / 4 at an edge, 1 / 8 at a corner */
            const int walls = cloud_walls(&c, i);
            if (deep(&c, i)) {
                CHECK_NEAR("sum of V W inside", i, out[i], 1.0, 2e-4);
                inside++;
            }
            if (walls == dim) CHECK_NEAR("sum of V W in a corner", i, out[i], 1.0 / (1 << dim), 2e-4);
        }
        CHECK(inside > 0);
        /* the particle itself is in the sum though not in the list, and it is the only one here */
        c.start[1] = c.start[0];
        {
            views one = v;
            one.cloud.last = 1;
            CHECK(gamma_sum(dim, &one, out) == 0);
            CHECK_NEAR_RELATIVE("sum of V W without neighbours", 0, out[0],
                                (double)c.V[0] * (double)sph_kernel_w(KERNEL, dim, SPH_R(0), c.h), 8.0 * EPSILON);
        }
        free(out);
        cloud_free(&c);
    }
}

static void test_interpolation(void)
{
    static const int side[] = {0, 41, 13, 7};
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.25, (uint64_t)dim);
        const views v = views_of(&c);
        sph_real *const out = (sph_real *)cloud_memory((size_t)c.n, sizeof *out);
        unsigned char *const status = (unsigned char *)cloud_memory((size_t)c.n, 1);
        double inside = 0.0, all = 0.0, smallest = 1e9, largest = -1e9;
        sph_index i;

        cloud_random_volumes(&c, 3);
        cloud_set(&c, field_constant);
        CHECK(interpolate(dim, &v, out, status) == 0);
        for (i = 0; i < c.n; i++) {
            CHECK_NEAR_RELATIVE("interpolated constant", i, out[i], 1.7, 30.0 * EPSILON);
            CHECK_SAME("status of an interpolation", i, status[i], SPH_OK);
        }

        cloud_set(&c, field_linear);
        for (i = 0; i < c.n; i++) {
            smallest = fmin(smallest, (double)c.f[i]);
            largest = fmax(largest, (double)c.f[i]);
        }
        CHECK(interpolate(dim, &v, out, 0) == 0);
        for (i = 0; i < c.n; i++) {
            CHECK_AT("interpolated linear field", i,
                     (double)out[i] >= smallest && (double)out[i] <= largest); /* a mean */
            all = worse(all, (double)out[i] - (double)c.f[i]);
        }
        CHECK(all > 1e-3 && all < 3.0 * (double)c.h);

        /* symmetric: linear fields are exact inside, and of first order in h at a wall */
        cloud_free(&c);
        c = cloud_lattice(dim, dim == 3 ? 11 : side[dim], 2.0, 0.0, 1);
        cloud_set(&c, field_linear);
        {
            const views u = views_of(&c);
            sph_real *const even = (sph_real *)cloud_memory((size_t)c.n, sizeof *even);
            CHECK(interpolate(dim, &u, even, 0) == 0);
            all = 0.0;
            for (i = 0; i < c.n; i++) {
                const double e = (double)even[i] - (double)c.f[i];
                if (deep(&c, i)) inside = worse(inside, e);
                all = worse(all, e);
            }
            CHECK_WORST(check_words("interpolated linear field inside, %dD", dim), inside, 50.0 * EPSILON);
            CHECK(all > 0.1 * (double)c.h && all < 3.0 * (double)c.h);
            free(even);
        }
        free(out);
        free(status);
        cloud_free(&c);
    }
}

/* Targets of volume 0 take part in nothing but their own answer. */
static void test_probes(void)
{
    enum { N = 21, PROBES = 4 };
    cloud c = cloud_new(1, N + PROBES);
    static const double at[PROBES] = {0.525, 0.31, 0.5, 9.0}; /* in the middle of an interval, anywhere, on a particle, far away */
    sph_real out[N + PROBES], plain[N];
    unsigned char status[N + PROBES];
    views v;
    sph_index i;
    for (i = 0; i < N; i++) {
        c.x[i] = SPH_R((double)i / (N - 1));
        c.V[i] = SPH_R(i == 0 || i == N - 1 ? 0.025 : 0.05);
    }
    for (i = 0; i < PROBES; i++) {
        c.x[N + i] = SPH_R(at[i]);
        c.V[N + i] = SPH_R(0);
    }
    c.h = SPH_R(0.1);
    cloud_set(&c, field_linear);
    for (i = 0; i < PROBES; i++) c.f[N + i] = SPH_R(-1e6); /* what is stored at a probe does not count */
    cloud_neighbors(&c, 0.2);
    v = views_of(&c);
    CHECK(interpolate(1, &v, out, status) == 1);
    CHECK_NEAR("field at a probe between two", N, out[N], 0.7 + 1.3 * 0.525, BY_PRECISION(1e-13, 1e-5));
    CHECK_NEAR("field at a probe", N + 1, out[N + 1], 0.7 + 1.3 * 0.31, 1e-3);
    CHECK_NEAR("field at a probe on a particle", N + 2, out[N + 2], out[10], 10.0 * EPSILON);
    CHECK_NEAR("field at a probe without neighbours", N + 3, out[N + 3], 0.0, 0.0);
    CHECK(status[N] == SPH_OK && status[N + 2] == SPH_OK && status[N + 3] == SPH_TOO_FEW && status[3] == SPH_OK);
    CHECK(interpolate(1, &v, out, 0) == 1);
    for (i = 0; i < N; i++) plain[i] = out[i];
    for (i = 0; i < PROBES; i++) c.f[N + i] = SPH_R(3);
    CHECK(interpolate(1, &v, out, 0) == 1);
    CHECK(memcmp(plain, out, sizeof plain) == 0);

    /* probes alone, as a range */
    v.cloud.first = N;
    CHECK(interpolate(1, &v, out, 0) == 1);
    v.cloud.last = N + 3;
    CHECK(interpolate(1, &v, out, 0) == 0);
    cloud_free(&c);
}

/* ---- gradients ---- */

static void test_difference(void)
{
    static const int side[] = {0, 41, 13, 7}, coarse[] = {0, 41, 33, 13};
    int dim, a;
    for (dim = 1; dim <= 3; dim++) {
        double error[2];
        int fine;
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.25, (uint64_t)dim);
        views v = views_of(&c);
        vectors g = vectors_new(c.n);
        sph_index i;
        cloud_set(&c, field_constant);
        CHECK(difference(dim, &v, g.p) == 0);
        for (i = 0; i < c.n; i++)
            for (a = 0; a < dim; a++)
                CHECK_NEAR(check_words("gradient of a constant along %c in %dD", "xyz"[a], dim), i, g.p[a][i],
                           0.0, 0.0);
        free(g.p[0]);
        cloud_free(&c);

        /* second order inside where the particles are regular and h / dx is large: both cut in halves, at the same points */
        for (fine = 0; fine < (dim < 3 ? 2 : 1); fine++) {
            c = cloud_lattice(dim, (coarse[dim] - 1) * (1 + fine) + 1, dim < 3 ? 4.0 : 2.0, 0.0, 1);
            v = views_of(&c);
            g = vectors_new(c.n);
            cloud_set(&c, field_smooth);
            CHECK(difference(dim, &v, g.p) == 0);
            error[fine] = 0.0;
            for (i = 0; i < c.n; i++) {
                double p[3], d[COMPONENTS];
                cloud_position(&c, i, p);
                field_smooth(p, d);
                for (a = 0; a < dim; a++) {
                    CHECK_AT(check_words("gradient along %c in %dD", "xyz"[a], dim), i, !isnan(g.p[a][i]));
                    if (p[0] < 0.35 || p[0] > 0.65 || (dim > 1 && (p[1] < 0.35 || p[1] > 0.65)) || (dim > 2 && (p[2] < 0.35 || p[2] > 0.65))) continue;
                    error[fine] = worse(error[fine], (double)g.p[a][i] - d[a]);
                }
            }
            free(g.p[0]);
            cloud_free(&c);
        }
        CHECK(error[0] < 0.1);
        if (dim < 3) CHECK_CLOSE(log2(error[0] / error[1]), 2.0, 0.1);
    }
}

static void test_corrected(void)
{
    static const int side[] = {0, 41, 13, 7};
    double error[3][2]; /* 41, 81, 161 particles: inside, at the ends */
    int dim, a, size;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.25, (uint64_t)dim);
        const views v = views_of(&c);
        const vectors g = vectors_new(c.n);
        sph_real *const conditioning = (sph_real *)cloud_memory((size_t)c.n, sizeof *conditioning);
        unsigned char *const status = (unsigned char *)cloud_memory((size_t)c.n, 1);
        sph_index i;
        int volumes;
        cloud_set(&c, field_linear);
        for (volumes = 0; volumes < 2; volumes++) { /* exact for linear fields, whatever the volumes are */
            if (volumes) cloud_random_volumes(&c, 23);
            CHECK(corrected(dim, &v, g.p, conditioning, status) == 0);
            for (i = 0; i < c.n; i++) {
                double p[3], d[COMPONENTS];
                cloud_position(&c, i, p);
                field_linear(p, d);
                for (a = 0; a < dim; a++)
                    CHECK_NEAR(
                        check_words("corrected gradient of a linear field along %c in %dD", "xyz"[a], dim), i,
                        g.p[a][i], d[a], 100.0 * EPSILON / c.dx);
                CHECK_SAME("status of a corrected gradient", i, status[i], SPH_OK);
                CHECK_AT(check_words("conditioning of a corrected gradient in %dD", dim), i,
                         (double)conditioning[i] > 0.1 && (double)conditioning[i] <= 1.0);
            }
        }
        CHECK(corrected(dim, &v, g.p, 0, 0) == 0); /* nobody has to ask */
        free(g.p[0]);
        free(conditioning);
        free(status);
        cloud_free(&c);

        /* 1 inside a regular cloud and, by symmetry, on a plane wall; less where the moments are skew: at a corner */
        c = cloud_lattice(dim, dim == 3 ? 11 : 21, 2.0, 0.0, 1);
        {
            const views u = views_of(&c);
            const vectors w = vectors_new(c.n);
            sph_real *const pivot = (sph_real *)cloud_memory((size_t)c.n, sizeof *pivot);
            sph_index inside = 0;
            cloud_set(&c, field_smooth);
            CHECK(corrected(dim, &u, w.p, pivot, 0) == 0);
            for (i = 0; i < c.n; i++)
                if (deep(&c, i)) {
                    CHECK_NEAR("conditioning inside a lattice", i, pivot[i], 1.0, 100.0 * EPSILON);
                    inside++;
                }
            CHECK(inside > 0);
            if (dim > 1) CHECK_AT("conditioning in a corner", 0, (double)pivot[0] < 0.95);
            else CHECK_NEAR("conditioning at an end", 0, pivot[0], 1.0, 4.0 * EPSILON);
            free(w.p[0]);
            free(pivot);
            cloud_free(&c);
        }
    }
    for (size = 0; size < 3; size++) { /* orders, in one dimension */
        cloud c = cloud_lattice(1, 40 * (1 << size) + 1, 2.0, 0.0, 1);
        const views v = views_of(&c);
        const vectors g = vectors_new(c.n);
        sph_index i;
        cloud_set(&c, field_smooth);
        CHECK(corrected(1, &v, g.p, 0, 0) == 0);
        error[size][0] = error[size][1] = 0.0;
        for (i = 0; i < c.n; i++) {
            double p[3], d[COMPONENTS], e;
            cloud_position(&c, i, p);
            field_smooth(p, d);
            e = (double)g.p[0][i] - d[0];
            if (p[0] > 0.35 && p[0] < 0.65) error[size][0] = worse(error[size][0], e);
            if (i == 0 || i == c.n - 1) error[size][1] = worse(error[size][1], e);
        }
        free(g.p[0]);
        cloud_free(&c);
    }
    for (size = 1; size < 3; size++) {
        CHECK_CLOSE(log2(error[size - 1][0] / error[size][0]), 2.0, BY_PRECISION(0.15, 0.3));
        CHECK_CLOSE(log2(error[size - 1][1] / error[size][1]), 1.0, 0.15);
    }
}

/* ---- Laplacians of two points ---- */

static void test_laplacians(void)
{
    static const int side[] = {0, 61, 41, 21};
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        /* the integrals are exact for x^2 + y^2 + z^2; what is left is the quadrature's error, small where h / dx is large */
        cloud c = cloud_lattice(dim, side[dim], dim == 3 ? 2.5 : 4.0, 0.0, 1);
        const views v = views_of(&c);
        sph_real *const out = (sph_real *)cloud_memory((size_t)c.n, sizeof *out);
        double b = 0.0, k = 0.0;
        sph_index i, inside = 0, middle = 0;
        for (i = 0; i < c.n; i++) {
            double p[3];
            cloud_position(&c, i, p);
            c.f[i] = SPH_R(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            if (deep(&c, i)) middle = i;
        }
        CHECK(brookshaw(dim, &v, out) == 0);
        for (i = 0; i < c.n; i++)
            if (deep(&c, i)) {
                b = worse(b, (double)out[i] - 2.0 * dim);
                inside++;
            }
        CHECK(inside > 0);
        CHECK_WORST(check_words("Laplacian of x^2 + y^2 + z^2 in %dD, Brookshaw", dim), b, 0.02 * dim);
        CHECK(fabs((double)out[0] - 2.0 * dim) > 0.5); /* not so at a corner */
        kernel_laplacian(dim, &v, out);
        for (i = 0; i < c.n; i++)
            if (deep(&c, i)) k = worse(k, (double)out[i] - 2.0 * dim);
        CHECK_CLOSE(k, 0.0, 0.05 * dim);

        /* two different operators, and both are 0 for a constant */
        CHECK(fabs(b - k) > 1e-6);
        cloud_set(&c, field_constant);
        CHECK(brookshaw(dim, &v, out) == 0);
        CHECK_NEAR("Laplacian of a constant", 0, out[0], 0.0, 0.0);
        CHECK_NEAR("Laplacian of a constant", middle, out[middle], 0.0, 0.0);
        kernel_laplacian(dim, &v, out);
        CHECK_NEAR("Laplacian of a constant", 0, out[0], 0.0, 0.0);
        CHECK_NEAR("Laplacian of a constant", middle, out[middle], 0.0, 0.0);
        free(out);
        cloud_free(&c);
    }
}

/* ---- sums by hand, with another kernel, in the pair tier's own words ---- */

static void test_sums(void)
{
    cloud c = cloud_lattice(2, 9, 1.5, 0.25, 8);
    const views v = views_of(&c);
    const vectors g = vectors_new(c.n);
    sph_real *const gamma = (sph_real *)cloud_memory(3 * (size_t)c.n, sizeof *gamma), *const b = gamma + c.n, *const k = b + c.n;
    double off = 0.0;
    sph_index i, j;
    cloud_set(&c, field_smooth);
    CHECK(sph_shepard_sum(OTHER, 2, v.cloud, sph_scalar_out_array(gamma, 0)) == 0);
    CHECK(sph_gradient_difference(OTHER, 2, v.cloud, v.f, sph_vector_out_separate(g.p[0], g.p[1], 0)) == 0);
    CHECK(sph_laplacian_brookshaw(OTHER, 2, v.cloud, v.f, sph_scalar_out_array(b, 0)) == 0);
    laplacian_kernel(OTHER, 2, v.cloud, v.f, k);
    for (i = 0; i < c.n; i++) { /* over all particles, without a list */
        const double h = (double)c.h;
        double sum = 0.0, gx = 0.0, gy = 0.0, lap = 0.0, old = 0.0;
        for (j = 0; j < c.n; j++) {
            const double x = (double)c.x[i] - (double)c.x[j], y = (double)c.y[i] - (double)c.y[j], r = sqrt(x * x + y * y), V = (double)c.V[j];
            const double df = (double)c.f[j] - (double)c.f[i], q = r / h, sigma = 10.0 / (7.0 * PI * h * h);
            /* M4 */
            const double w = q < 1.0 ? 1.0 - 1.5 * q * q + 0.75 * q * q * q : q < 2.0 ? 0.25 * (2.0 - q) * (2.0 - q) * (2.0 - q) : 0.0;
            const double dw = q < 1.0 ? -3.0 * q + 2.25 * q * q : q < 2.0 ? -0.75 * (2.0 - q) * (2.0 - q) : 0.0;
            const double d2 = q < 1.0 ? -3.0 + 4.5 * q : q < 2.0 ? 1.5 * (2.0 - q) : 0.0;
            sum += V * sigma * w;
            if (i == j) continue;
            gx += V * df * sigma / h * dw * x / r;
            gy += V * df * sigma / h * dw * y / r;
            lap -= 2.0 * V * df * sigma / h * dw / r;
            old += V * df * sigma / h * (d2 / h + dw / r);
        }
        off = worse(off, (sum - (double)gamma[i]));
        off = worse(off, (gx - (double)g.p[0][i]) / 4.0);
        off = worse(off, (gy - (double)g.p[1][i]) / 4.0);
        off = worse(off, (lap - (double)b[i]) / 100.0);
        off = worse(off, (old - (double)k[i]) / 100.0);
    }
    CHECK_WORST("gamma, gradient and Laplacians beside sums by hand", off, 30.0 * EPSILON);
    free(gamma);
    free(g.p[0]);
    cloud_free(&c);
}

/* ---- views ---- */

typedef struct particle { /* an array of structs as a host might have it: sph_real only, so that strides count */
    sph_real mass, x[3], h, f, V, g[3], hessian[6], laplacian, conditioning;
} particle;

enum { STRIDE = sizeof(particle) / sizeof(sph_real) };

static sph_index derivatives_3d(const views *v, sph_derivatives_out out)
{
    return sph_derivatives_wls(KERNEL, 3, v->cloud, v->f, (sph_derivatives_options){0}, out);
}
static sph_index derivatives_2d(const views *v, sph_derivatives_out out)
{
    return sph_derivatives_wls(KERNEL, 2, v->cloud, v->f, (sph_derivatives_options){0}, out);
}

static sph_derivatives_out arrays_out(sph_real *p, sph_index n)
{
    sph_derivatives_out out;
    sph_real **const array[] = {&out.gx, &out.gy, &out.gz, &out.hxx, &out.hxy, &out.hyy, &out.hxz, &out.hyz, &out.hzz, &out.laplacian, &out.conditioning};
    int a;
    for (a = 0; a < 11; a++) *array[a] = p + (size_t)a * (size_t)n;
    out.stride = 1;
    out.status = 0;
    return out;
}

static void test_views(void)
{
    int dim, a;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, dim == 1 ? 31 : dim == 2 ? 11 : 6, 2.0, 0.25, (uint64_t)(60 + dim));
        const size_t n = (size_t)c.n;
        const views v = views_of(&c);
        particle *const s = (particle *)cloud_memory(n, sizeof *s);
        sph_real *const xyz = (sph_real *)cloud_memory((size_t)dim * n, sizeof *xyz), *const hs = (sph_real *)cloud_memory(n, sizeof *hs);
        const vectors g = vectors_new(c.n), g2 = vectors_new(c.n);
        views way[5];
        size_t i, w;
        cloud_set(&c, field_smooth);
        for (i = 0; i < n; i++) {
            double p[3];
            cloud_position(&c, (sph_index)i, p);
            for (a = 0; a < 3; a++) s[i].x[a] = SPH_R(p[a]);
            for (a = 0; a < dim; a++) xyz[(size_t)dim * i + (size_t)a] = SPH_R(p[a]);
            s[i].h = hs[i] = c.h;
            s[i].f = c.f[i];
            s[i].V = c.V[i];
            s[i].mass = SPH_R(-1);
            s[i].laplacian = SPH_R(-2);
        }
        for (w = 0; w < 5; w++) way[w] = v;
        way[0].cloud.points = sph_points_interleaved(c.n, dim, xyz);
        way[1].cloud.points =
            sph_points_strided(c.n, &s[0].x[0], dim > 1 ? &s[0].x[1] : 0, dim > 2 ? &s[0].x[2] : 0, STRIDE);
        way[1].cloud.volume = sph_scalars_strided(&s[0].V, STRIDE);
        way[1].cloud.h = sph_scalars_strided(&s[0].h, STRIDE);
        way[1].f = sph_scalars_strided(&s[0].f, STRIDE);
        way[2].cloud.h = sph_scalars_array(hs);
        /* what is not read may be missing */
        way[3].cloud.points = sph_points_separate(c.n, c.x, dim > 1 ? c.y : 0, dim > 2 ? c.z : 0);
        way[4].cloud.points = sph_points_strided(c.n, c.x, c.y, c.z, 1);
        CHECK(corrected(dim, &v, g.p, 0, 0) == 0);
        for (w = 0; w < 5; w++) {
            CHECK(corrected(dim, &way[w], g2.p, 0, 0) == 0);
            CHECK(memcmp(g.p[0], g2.p[0], (size_t)dim * n * sizeof(sph_real)) == 0);
            for (i = 0; i < 3 * n; i++) g2.p[0][i] = SPH_R(NAN);
        }
        CHECK(interpolate(dim, &v, g.p[0], 0) == 0);
        CHECK(interpolate(dim, &way[1], g2.p[0], 0) == 0);
        CHECK(memcmp(g.p[0], g2.p[0], n * sizeof(sph_real)) == 0);

        if (dim > 1) { /* outputs into structs */
            sph_real *const flat = (sph_real *)cloud_memory(11 * n, sizeof *flat);
            sph_derivatives_out into, all = arrays_out(flat, c.n);
            into.gx = &s[0].g[0];
            into.gy = &s[0].g[1];
            into.gz = &s[0].g[2];
            into.hxx = &s[0].hessian[0];
            into.hxy = &s[0].hessian[1];
            into.hyy = &s[0].hessian[2];
            into.hxz = &s[0].hessian[3];
            into.hyz = 0; /* not wanted */
            into.hzz = &s[0].hessian[5];
            into.laplacian = 0;
            into.conditioning = &s[0].conditioning;
            into.stride = STRIDE;
            into.status = 0;
            CHECK((dim == 2 ? derivatives_2d(&v, all) : derivatives_3d(&v, all)) == 0);
            CHECK((dim == 2 ? derivatives_2d(&way[1], into) : derivatives_3d(&way[1], into)) == 0);
            for (i = 0; i < n; i++) {
                double off = 0.0;
                for (a = 0; a < dim; a++) off = worse(off, (double)s[i].g[a] - (double)flat[(size_t)a * n + i]);
                for (a = 0; a < dim * (dim + 1) / 2; a++)
                    if (a != 4) off = worse(off, (double)s[i].hessian[a] - (double)flat[(size_t)(3 + a) * n + i]);
                off = worse(off, (double)s[i].conditioning - (double)flat[10 * n + i]);
                off = worse(off, (double)s[i].mass + 1.0);
                off = worse(off, (double)s[i].laplacian + 2.0);
                off = worse(off, (double)s[i].hessian[4]);
                off = worse(off, (double)s[i].V - (double)c.V[i]);
                CHECK_NEAR(check_words("numbers in a struct and in arrays, largest difference in %dD", dim),
                           i, off, 0.0, 0.0);
            }
            free(flat);
        }
        free(s);
        free(xyz);
        free(hs);
        free(g.p[0]);
        free(g2.p[0]);
        cloud_free(&c);
    }
}

/* h is the target's */
static void test_variable_h(void)
{
    cloud c = cloud_lattice(1, 31, 2.0, 0.2, 9);
    views v = views_of(&c), one = v;
    sph_real *const hs = (sph_real *)cloud_memory((size_t)c.n, sizeof *hs), *const out = (sph_real *)cloud_memory(2 * (size_t)c.n, sizeof *out),
                    *const single = out + c.n;
    sph_index i, differ = 0;
    cloud_set(&c, field_smooth);
    for (i = 0; i < c.n; i++) hs[i] = c.h * SPH_R(0.7 + 0.3 * (double)(i % 2));
    v.cloud.h = sph_scalars_array(hs);
    CHECK(brookshaw(1, &v, out) == 0);
    for (i = 0; i < c.n; i++) {
        one.cloud = sph_cloud_range(v.cloud, i, i + 1);
        one.cloud.h = sph_scalars_same(&hs[i]);
        CHECK(brookshaw(1, &one, single) == 0);
        CHECK_NEAR("Laplacian by the h of the target alone", i, out[i], single[i], 0.0);
        one.cloud.h = sph_scalars_same(&hs[(i + 1) % c.n]);
        CHECK(brookshaw(1, &one, single) == 0);
        differ += memcmp(out + i, single + i, sizeof *out) != 0;
    }
    CHECK(differ > 20);
    free(hs);
    free(out);
    cloud_free(&c);
}

/* ---- vectors, and the inverse of the gradient's matrix ---- */

static void test_small(void)
{
    int axis;
    sph_vec a, b;
    sph_sym K, C;
    sph_real pivot = SPH_R(-1);
    a.x = SPH_R(3);
    a.y = SPH_R(4);
    a.z = SPH_R(12);
    b.x = SPH_R(1);
    b.y = SPH_R(-2);
    b.z = SPH_R(5);
    CHECK_CLOSE((double)sph_dot(1, a, b), 3.0, 0.0);
    CHECK_CLOSE((double)sph_dot(2, a, b), -5.0, 0.0);
    CHECK_CLOSE((double)sph_dot(3, a, b), 55.0, 0.0);
    CHECK_CLOSE((double)sph_length(1, a), 3.0, 0.0);
    CHECK_CLOSE((double)sph_length(2, a), 5.0, 4.0 * EPSILON);
    CHECK_CLOSE((double)sph_length(3, a), 13.0, 16.0 * EPSILON);
    CHECK_CLOSE((double)sph_subtract(3, a, b).x, 2.0, 0.0);
    CHECK_CLOSE((double)sph_subtract(3, a, b).y, 6.0, 0.0);
    CHECK_CLOSE((double)sph_subtract(3, a, b).z, 7.0, 0.0);
    CHECK_CLOSE((double)sph_subtract(2, a, b).z, 12.0, 0.0);
    CHECK_CLOSE((double)sph_subtract(1, a, b).y, 4.0, 0.0);
    CHECK_CLOSE((double)sph_scale(SPH_R(2), a).x, 6.0, 0.0);
    CHECK_CLOSE((double)sph_scale(SPH_R(2), a).y, 8.0, 0.0);
    CHECK_CLOSE((double)sph_scale(SPH_R(2), a).z, 24.0, 0.0);

    K.xx = SPH_R(4);
    K.xy = SPH_R(1);
    K.yy = SPH_R(3);
    K.xz = SPH_R(-0.5);
    K.yz = SPH_R(0.75);
    K.zz = SPH_R(2);
    CHECK(sph_solve_gradient(3, K, &C, &pivot) == SPH_OK);
    CHECK_CLOSE((double)(K.xx * C.xx + K.xy * C.xy + K.xz * C.xz), 1.0, 20.0 * EPSILON);
    CHECK_CLOSE((double)(K.xy * C.xy + K.yy * C.yy + K.yz * C.yz), 1.0, 20.0 * EPSILON);
    CHECK_CLOSE((double)(K.xz * C.xz + K.yz * C.yz + K.zz * C.zz), 1.0, 20.0 * EPSILON);
    CHECK_CLOSE((double)(K.xx * C.xy + K.xy * C.yy + K.xz * C.yz), 0.0, 20.0 * EPSILON);
    CHECK_CLOSE((double)(K.xx * C.xz + K.xy * C.yz + K.xz * C.zz), 0.0, 20.0 * EPSILON);
    CHECK_CLOSE((double)(K.xy * C.xz + K.yy * C.yz + K.yz * C.zz), 0.0, 20.0 * EPSILON);
    /* scaled to a unit diagonal: pivots 1, 1 - 1/12, and what is left of det = 1 + 2 a b c - a^2 - b^2 - c^2 */
    {
        const double xy = 1.0 / sqrt(12.0), xz = -0.5 / sqrt(8.0), yz = 0.75 / sqrt(6.0), det = 1.0 + 2.0 * xy * xz * yz - xy * xy - xz * xz - yz * yz;
        CHECK_CLOSE((double)pivot, det / (1.0 - xy * xy), 10.0 * EPSILON);
    }
    CHECK(sph_solve_gradient(2, K, &C, &pivot) == SPH_OK);
    CHECK_CLOSE((double)C.xx, 3.0 / 11.0, 4.0 * EPSILON);
    CHECK_CLOSE((double)C.xy, -1.0 / 11.0, 4.0 * EPSILON);
    CHECK_CLOSE((double)C.yy, 4.0 / 11.0, 4.0 * EPSILON);
    CHECK_CLOSE((double)pivot, 11.0 / 12.0, 4.0 * EPSILON);
    CHECK(sph_solve_gradient(1, K, &C, 0) == SPH_OK);
    CHECK_CLOSE((double)C.xx, 0.25, 4.0 * EPSILON);
    C.xx = SPH_R(7);
    K.xy = SPH_R(sqrt(12.0)); /* x and y on a line */
    CHECK(sph_solve_gradient(2, K, &C, &pivot) == SPH_SINGULAR);
    CHECK_CLOSE((double)C.xx, 7.0, 0.0);
    CHECK(sph_solve_gradient(3, K, &C, &pivot) == SPH_SINGULAR);
    for (axis = 0; axis < 3; axis++) { /* one axis without a moment is enough */
        const sph_sym axes = {SPH_R(axis != 0), SPH_R(0), SPH_R(axis != 1), SPH_R(0), SPH_R(0), SPH_R(axis != 2)};
        CHECK(sph_solve_gradient(3, axes, &C, &pivot) == SPH_SINGULAR);
    }
    K.xx = SPH_R(0);
    CHECK(sph_solve_gradient(1, K, &C, &pivot) == SPH_SINGULAR);
    K.xx = SPH_R(-1);
    CHECK(sph_solve_gradient(1, K, &C, &pivot) == SPH_SINGULAR);
}

/* positions up to half of the largest number: the difference of any two is one, too */
static void test_far_positions(void)
{
    const sph_real half = SPH_R(0.5) * BY_PRECISION(SPH_R(1.7976931348623157e308), SPH_R(3.4028234663852886e38)), one = SPH_R(1);
    const sph_index start[2] = {0, 0}, index[1] = {0};
    sph_list list;
    int over;
    list.start = start;
    list.index = index;
    for (over = 0; over < 2; over++) {
        const sph_real x = half * SPH_R(over ? 1.001 : 0.999);
        const sph_cloud alone = sph_cloud_of(sph_points_separate(1, &x, 0, 0), list, sph_scalars_same(&one),
                                             sph_scalars_same(&one));
        sph_real out = SPH_R(7);
        CHECK(sph_shepard_sum(SPH_CUBIC_SPLINE, 1, alone, sph_scalar_out_array(&out, 0)) == (over ? SPH_ERROR_POSITION : 0));
        CHECK((out == SPH_R(7)) == over);
    }
}

/* rows that begin before the list are refused, even if there is something that looks like an index */
static void test_row_before_list(void)
{
    const sph_real x[2] = {SPH_R(0), SPH_R(1)}, one = SPH_R(1);
    const sph_index start[3] = {-1, 0, 1}, index[3] = {1, 0, 0};
    sph_real out[2] = {SPH_R(7), SPH_R(7)};
    sph_list list;
    sph_cloud two;
    list.start = start;
    list.index = index + 1;
    two = sph_cloud_of(sph_points_separate(2, x, 0, 0), list, sph_scalars_same(&one), sph_scalars_same(&one));
    CHECK(sph_shepard_sum(SPH_CUBIC_SPLINE, 1, two, sph_scalar_out_array(out, 0)) == SPH_ERROR_LIST);
    CHECK((double)out[0] == 7.0 && (double)out[1] == 7.0);
}

/* a gradient that leaves the range of numbers along one axis is 0 along all */
static void test_overflow(void)
{
    const sph_index start[3] = {0, 1, 2}, index[2] = {1, 0};
    const sph_real h = BY_PRECISION(SPH_R(1e-10), SPH_R(1e-3)), large = BY_PRECISION(SPH_R(1e300), SPH_R(1e37)), f[2] = {SPH_R(0), large};
    sph_list list;
    int dim, axis, k;
    list.start = start;
    list.index = index;
    for (dim = 1; dim <= 3; dim++)
        for (axis = 0; axis < dim; axis++) {
            sph_real x[3][2] = {{0, 0}, {0, 0}, {0, 0}}, V = h * SPH_R(0.1), g[3][2] = {{7, 7}, {7, 7}, {7, 7}};
            const sph_cloud two = sph_cloud_of(sph_points_separate(2, x[0], x[1], x[2]), list,
                                               sph_scalars_same(&h), sph_scalars_same(&V));
            for (k = 1; k < dim; k++) V *= h;
            x[axis][1] = h;
            CHECK(sph_gradient_difference(SPH_CUBIC_SPLINE, dim, two, sph_scalars_array(f),
                                          sph_vector_out_separate(g[0], g[1], g[2])) == 2);
            for (k = 0; k < dim; k++) CHECK((double)g[k][0] == 0.0 && (double)g[k][1] == 0.0);
        }
}

/* interpolation and corrected gradient in the interior: errors of second order on a lattice, of less in disorder */
static void test_orders(void)
{
    static const int side[] = {40, 80};
    int jittered, which;
    for (jittered = 0; jittered < 2; jittered++) {
        double error[2][2] = {{0, 0}, {0, 0}};
        for (which = 0; which < 2; which++) {
            cloud c = cloud_lattice(2, side[which], 2.0, jittered ? 0.25 : 0.0, 3);
            const views v = views_of(&c);
            const vectors g = vectors_new(c.n);
            sph_real *const out = (sph_real *)cloud_memory((size_t)c.n, sizeof *out);
            sph_index i, n = 0;
            cloud_set(&c, field_smooth);
            CHECK(interpolate(2, &v, out, 0) == 0);
            CHECK(corrected(2, &v, g.p, 0, 0) == 0);
            for (i = 0; i < c.n; i++) {
                double p[3], d[12], f;
                cloud_position(&c, i, p);
                if (fabs(p[0] - 0.5) > 0.25 || fabs(p[1] - 0.5) > 0.25) continue;
                f = field_smooth(p, d);
                error[0][which] += pow((double)out[i] - f, 2.0);
                error[1][which] += pow((double)g.p[0][i] - d[0], 2.0);
                n++;
            }
            error[0][which] = sqrt(error[0][which] / n);
            error[1][which] = sqrt(error[1][which] / n);
            free(out);
            free(g.p[0]);
            cloud_free(&c);
        }
        for (which = 0; which < 2; which++) {
            const double order = log2(error[which][0] / error[which][1]);
            CHECK(jittered ? order > 0.9 && order < 1.8 : order > 1.9);
        }
    }
}

int main(void)
{
    test_orders();
    test_shepard_sum();
    test_interpolation();
    test_probes();
    test_difference();
    test_corrected();
    test_laplacians();
    test_sums();
    test_views();
    test_variable_h();
    test_small();
    test_row_before_list();
    test_far_positions();
    test_overflow();
    return check_report("test_gradients");
}
