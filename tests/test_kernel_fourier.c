/* SPDX-License-Identifier: MIT */
/*
 * test_kernel_fourier.c - the smallest value of each kernel's Fourier transform for 0 < k h < 60, normalised to 1 at k = 0.
 * A kernel whose transform turns negative lets particles pair; which ones do, and how much, is a known property of each.
 *
 * Everything but the shapes is computed in double. In a build with SPH_SINGLE the shapes carry rounding errors of 6e-8, so that a transform there is known to
 * about 1e-7 only: a minimum that should be 0 or barely positive is then compared with that instead.
 *
 * With FOURIER_VERBOSE in the environment all minima are printed.
 */
#include "../sph_kernels.h"
#include "check.h"

#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846
#define NOISE (SPH_SINGLE ? 3e-7 : 3e-14)

/* All knots are multiples of 1/6. In a stretch of that length the phase k q turns by at most 10; 20 nodes integrate that, times any of the kernels, to
   rounding, in the first stretch, too, where the phase is not linear. */
enum { PARTS = 6, NODES = 20, STRETCHES = 4 * PARTS, POINTS = STRETCHES * NODES, WAVES = 1200 };
static const double k_step = 0.05;

static double q_of[POINTS], dq_of[POINTS];
static double basis[3][WAVES + 1][POINTS]; /* cos(kq), J0(kq) q, sin(kq)/(kq) q^2 */

static void make_points(void)
{
    int part, i, j, pass;
    for (i = 0; i < NODES; i++) {
        double x = cos(PI * (i + 0.75) / (NODES + 0.5)), slope = 1.0, s, weight;
        for (pass = 0; pass < 20; pass++) {
            double p0 = 1.0, p1 = x;
            for (j = 2; j <= NODES; j++) {
                const double p2 = ((2 * j - 1) * x * p1 - (j - 1) * p0) / j;
                p0 = p1;
                p1 = p2;
            }
            slope = NODES * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / slope;
        }
        s = 0.5 * (1.0 + x);
        weight = 1.0 / ((1.0 - x * x) * slope * slope);
        for (part = 0; part < STRETCHES; part++) { /* in the first stretch q = s^2 / 6, for the square root's sake */
            q_of[part * NODES + i] = (part == 0 ? s * s : part + s) / PARTS;
            dq_of[part * NODES + i] = weight * (part == 0 ? 2.0 * s : 1.0) / PARTS;
        }
    }
}

/* J0(z) = (1/pi) integral_0^pi cos(z sin t) dt by the midpoint rule, which converges exponentially; the halves below and above pi/2 are equal.
   With 2 n points over pi, the error is 2 J_4n(z): none once 4 n exceeds z by some. */
static double bessel_j0(double z)
{
    enum { MOST = 80 };
    static double sine[MOST + 1][MOST];
    const int n = (int)(0.25 * z) + 14;
    double sum = 0.0;
    int i;
    if (n > MOST) return 2.0; /* no value of J0: the checks fail */
    if (sine[n][0] == 0.0)
        for (i = 0; i < n; i++) sine[n][i] = sin(PI * (i + 0.5) / (2 * n));
    for (i = 0; i < n; i++) sum += cos(z * sine[n][i]);
    return sum / n;
}

static void make_basis(void)
{
    int j, i;
    for (j = 0; j <= WAVES; j++)
        for (i = 0; i < POINTS; i++) {
            const double q = q_of[i], z = j * k_step * q;
            basis[0][j][i] = cos(z);
            basis[1][j][i] = bessel_j0(z) * q;
            basis[2][j][i] = (z > 0.0 ? sin(z) / z : 1.0) * q * q;
        }
}

static double transform[WAVES + 1];

static void make_transform(sph_kernel kernel, int dim)
{
    const int used = (int)((double)sph_kernel_support_ratio(kernel) * PARTS + 0.5) * NODES;
    double w[POINTS];
    int j, i;
    for (i = 0; i < used; i++) w[i] = dq_of[i] * (double)sph_kernel_shape(kernel, dim, SPH_R(q_of[i]));
    for (j = 0; j <= WAVES; j++) {
        double sum = 0.0;
        for (i = 0; i < used; i++) sum += w[i] * basis[dim - 1][j][i];
        transform[j] = sum;
    }
    for (j = 1; j <= WAVES; j++) transform[j] /= transform[0];
    transform[0] = 1.0;
}

/* The smallest value, between grid points by a parabola, and where it is. */
static double smallest(double *at)
{
    int j, least = 1;
    for (j = 1; j <= WAVES; j++)
        if (transform[j] < transform[least]) least = j;
    *at = least * k_step;
    if (least < WAVES) {
        const double left = transform[least - 1], mid = transform[least], right = transform[least + 1], bend = left - 2.0 * mid + right;
        if (bend > 0.0) {
            const double shift = 0.5 * (left - right) / bend;
            *at += shift * k_step;
            return mid - 0.25 * (left - right) * shift;
        }
    }
    return transform[least];
}

/* ANY: printed, not checked. POSITIVE: > 0 everywhere. ZERO: >= 0, with zeros. Else the minimum, to half a unit of its second digit. */
#define ANY 3.0
#define POSITIVE 1.0
#define ZERO 0.0

typedef struct expectation {
    sph_kernel kernel;
    double minimum[3];
    double at[3]; /* where, to 0.02; 0: not checked */
} expectation;

static const expectation expected[] = {
    {SPH_CUBIC_SPLINE, {ZERO, -6.4e-4, -6.0e-4}, {0, 0, 0}},
    {SPH_WENDLAND_C2, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_WENDLAND_C4, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_WENDLAND_C6, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_WENDLAND_C2_1D, {POSITIVE, -6.4e-5, -1.7e-3}, {0, 8.1, 5.1}},
    {SPH_LIU_QUARTIC, {-1.0e-5, -3.3e-4, -2.8e-3}, {0, 0, 0}},
    {SPH_HERMITE, {-2.2e-2, -1.9e-2, -1.5e-2}, {0, 3.93, 0}},
    {SPH_SCHUESSLER_SCHMITT, {POSITIVE, POSITIVE, -8.3e-3}, {0, 0, 0}},
    {SPH_JOHNSON_BEISSEL, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_CONVEX, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_CONVEX_CUBIC_SPLINE, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_CONVEX_WENDLAND_C2, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_CONVEX_WENDLAND_C4, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_QUARTIC_SPLINE, {-4.8e-4, -1.9e-4, -7.9e-5}, {0, 0, 0}}, /* an odd power of sin(k/2) / (k/2) */
    {SPH_QUINTIC_SPLINE, {ZERO, -2.5e-5, -2.2e-5}, {0, 0, 0}},
    {SPH_WENDLAND_C4_1D, {POSITIVE, -1.2e-10, -1.2e-6}, {0, 0, 0}}, /* positive in 1D only */
    {SPH_WENDLAND_C6_1D, {POSITIVE, ANY, -3.8e-11}, {0, 0, 0}},     /* the same, but negative in 2D only beyond kh = 60 */
    {SPH_GAUSSIAN, {-1.4e-5, -1.2e-5, -9.6e-6}, {0, 0, 0}},         /* that of the truncation */
    {SPH_SUPER_GAUSSIAN, {-1.0e-4, -7.8e-5, -7.1e-5}, {0, 0, 0}},
    {SPH_CORE_TRIANGLE, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
    {SPH_SEXTIC_SPLINE, {-2.3e-5, -8.3e-6, -3.2e-6}, {8.99, 0, 0}}, /* in 1D that of sin(x) / x to the seventh power, at tan x = x */
    {SPH_HEPTIC_SPLINE, {ZERO, -1.0e-6, -8.5e-7}, {0, 0, 0}},
    {SPH_POLY6, {-2.2e-2, -1.6e-2, -1.2e-2}, {0, 0, 0}},
    {SPH_SPIKY, {POSITIVE, POSITIVE, POSITIVE}, {0, 0, 0}},
};

/* Half a unit of the second digit of a number that is printed with two. */
static double half_unit(double printed)
{
    return 0.5 * pow(10.0, floor(log10(fabs(printed)) + 1e-9) - 1.0);
}

static void test_minimum(const expectation *e, int dim, int verbose)
{
    const double want = e->minimum[dim - 1], want_at = e->at[dim - 1];
    double at, got;
    int holds;
    make_transform(e->kernel, dim);
    got = smallest(&at);
    if (verbose) printf("%-20s %dD  minimum %10.3e at kh = %.3f\n", sph_kernel_name(e->kernel), dim, got, at);
    if (want == ANY) return;
    if (want == POSITIVE) {
        int j;
        holds = 1;
        for (j = 1; j <= WAVES; j++) holds = holds && transform[j] > (SPH_SINGLE ? -NOISE : 0.0);
    } else if (want == ZERO) {
        holds = fabs(got) < (SPH_SINGLE ? NOISE : 1e-9);
    } else {
        holds = fabs(got - want) <= half_unit(want) + NOISE;
        if (want_at > 0.0) holds = holds && fabs(at - want_at) <= 0.02;
    }
    if (!check_count(holds))
        fprintf(stderr, "test_kernel_fourier.c: failed: %s, dim %d: smallest value %.6g at kh = %.4g, should be %s%.3g\n", sph_kernel_name(e->kernel), dim, got, at,
                want == POSITIVE ? "positive, not " : "", want == POSITIVE ? got : want);
}

/* What is known in closed form: the B-spline of n boxes has the transform (sin(k/2) / (k/2))^n in 1D. */
static void test_splines(void)
{
    static const sph_kernel spline[5] = {SPH_CUBIC_SPLINE, SPH_QUARTIC_SPLINE, SPH_QUINTIC_SPLINE, SPH_SEXTIC_SPLINE, SPH_HEPTIC_SPLINE};
    int n, j;
    for (n = 0; n < 5; n++) {
        make_transform(spline[n], 1);
        for (j = 1; j <= WAVES; j++) {
            const double half = 0.5 * j * k_step;
            CHECK_CLOSE(transform[j], pow(sin(half) / half, n + 4), NOISE);
        }
    }
}

static void test_bessel(void)
{
    CHECK_CLOSE(bessel_j0(0.0), 1.0, 1e-15);
    CHECK_CLOSE(bessel_j0(2.4048255576957728), 0.0, 2e-15);
    CHECK_CLOSE(bessel_j0(10.0), -0.24593576445134834, 1e-14);
    CHECK_CLOSE(bessel_j0(100.0), 0.019985850304223122, 1e-14);
    CHECK_CLOSE(bessel_j0(30.634606468431975), 0.0, 1e-14); /* the tenth zero */
}

int main(void)
{
    const int verbose = getenv("FOURIER_VERBOSE") != NULL;
    int seen[SPH_KERNEL_COUNT] = {0};
    size_t n;
    int dim, k;
    make_points();
    make_basis();
    test_bessel();
    test_splines();
    for (n = 0; n < sizeof expected / sizeof expected[0]; n++) {
        seen[expected[n].kernel]++;
        for (dim = 1; dim <= 3; dim++) test_minimum(&expected[n], dim, verbose);
    }
    for (k = 0; k < SPH_KERNEL_COUNT; k++) CHECK(seen[k] == 1);
    if (SPH_SINGLE) printf("test_kernel_fourier: float shapes: transforms are known to %.0e only, and 'positive' means: not below that\n", NOISE);
    return check_report("test_kernel_fourier");
}
