/* SPDX-License-Identifier: MIT */
/*
 * test_kernels.c - properties that every kernel must have in 1, 2 and 3 dimensions, and those that only some have.
 * The values themselves are compared in test_known_answers.c.
 */
#include "../sph_kernels.h"
#include "check.h"

#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846
#define EPSILON ((double)SPH_EPSILON)

/* A tolerance in double, and in float. */
#define BY_PRECISION(in_double, in_float) (SPH_SINGLE ? (in_float) : (in_double))

/* Knots of all kernels are multiples of 1/2 or 2/3, and thus of 1/6. */
enum { PARTS = 6, NODES = 16 };

/* ---- the kernels in double, whatever sph_real is ---------------------------------------------------------------------------------------- */

static double get_w(sph_kernel k, int dim, double r, double h) { return (double)sph_kernel_w(k, dim, SPH_R(r), SPH_R(h)); }
static double get_f(sph_kernel k, int dim, double r, double h) { return (double)sph_kernel_f(k, dim, SPH_R(r), SPH_R(h)); }
static double get_dwdr(sph_kernel k, int dim, double r, double h) { return (double)sph_kernel_dwdr(k, dim, SPH_R(r), SPH_R(h)); }
static double get_d2wdr2(sph_kernel k, int dim, double r, double h) { return (double)sph_kernel_d2wdr2(k, dim, SPH_R(r), SPH_R(h)); }
static double get_dwdh(sph_kernel k, int dim, double r, double h) { return (double)sph_kernel_dwdh(k, dim, SPH_R(r), SPH_R(h)); }
static double get_shape(sph_kernel k, int dim, double q) { return (double)sph_kernel_shape(k, dim, SPH_R(q)); }
static double get_shape_f(sph_kernel k, int dim, double q) { return (double)sph_kernel_shape_f(k, dim, SPH_R(q)); }
static double get_shape_d2(sph_kernel k, int dim, double q) { return (double)sph_kernel_shape_d2(k, dim, SPH_R(q)); }
static double get_sigma(sph_kernel k, int dim) { return (double)sph_kernel_sigma(k, dim); }
static double get_support(sph_kernel k) { return (double)sph_kernel_support_ratio(k); }

/* As SPH_R rounds it: what the kernel is really called with. */
static double rounded(double x) { return (double)SPH_R(x); }

static double power(double x, int n)
{
    double p = 1.0;
    while (n-- > 0) p *= x;
    return p;
}

static double surface(int dim) { return dim == 1 ? 2.0 : dim == 2 ? 2.0 * PI : 4.0 * PI; } /* of the unit sphere */

/* CHECK_CLOSE that says which kernel, where. */
static void near_(int line, const char *what, sph_kernel k, int dim, double q, double got, double want, double allowed)
{
    if (!check_count(fabs(got - want) <= allowed))
        fprintf(stderr, "test_kernels.c:%d: failed: %s of %s, dim %d, q = %.9g: %.17g against %.17g, off by %.3g, allowed %.3g\n", line, what,
                sph_kernel_name(k), dim, q, got, want, fabs(got - want), allowed);
}

static void holds(int line, const char *what, sph_kernel k, int dim, double q, int condition)
{
    if (!check_count(condition ? 1 : 0))
        fprintf(stderr, "test_kernels.c:%d: failed: %s, %s, dim %d, q = %.9g\n", line, what, sph_kernel_name(k), dim, q);
}

#define NEAR(what, q, got, want, allowed) near_(__LINE__, what, k, dim, q, got, want, allowed)
#define HOLDS(what, q, condition) holds(__LINE__, what, k, dim, q, condition)

/* ---- what is true of which kernel -------------------------------------------------------------------------------------------------------- */

static int is_truncated(sph_kernel k) { return k == SPH_GAUSSIAN || k == SPH_SUPER_GAUSSIAN; }

/* The curvature jumps to 0 at the edge; that of the truncated Gaussians does, too. */
static int curvature_jumps(sph_kernel k)
{
    return k == SPH_LIU_QUARTIC || k == SPH_HERMITE || k == SPH_SCHUESSLER_SCHMITT || k == SPH_JOHNSON_BEISSEL || is_truncated(k);
}

/* The curvature is nowhere negative between the origin and the edge. core-triangle belongs here: it is straight up to q = 2/3, and bends upwards from there. */
static int is_convex(sph_kernel k)
{
    return k == SPH_SCHUESSLER_SCHMITT || k == SPH_JOHNSON_BEISSEL || k == SPH_CONVEX || k == SPH_CONVEX_CUBIC_SPLINE ||
           k == SPH_CONVEX_WENDLAND_C2 || k == SPH_CONVEX_WENDLAND_C4 || k == SPH_CORE_TRIANGLE;
}

/* The largest of |w|, |w'|, |w''|, by which tolerances are scaled; schuessler-schmitt, whose slope is unbounded, from q = 1/12 on. */
typedef struct magnitude {
    double w, d1, d2, f;
} magnitude;

static magnitude magnitude_of(sph_kernel k, int dim)
{
    magnitude m = {0, 0, 0, 0};
    int i;
    for (i = 1; i <= 36; i++) {
        const double q = get_support(k) * i / 36.0;
        const double d1 = fabs(q * get_shape_f(k, dim, q)), d2 = fabs(get_shape_d2(k, dim, q)), f = fabs(get_shape_f(k, dim, q));
        if (d1 > m.d1) m.d1 = d1;
        if (d2 > m.d2) m.d2 = d2;
        if (f > m.f) m.f = f;
    }
    m.w = fabs(get_shape(k, dim, 0.0));
    return m;
}

/* ---- normalisation ----------------------------------------------------------------------------------------------------------------------- */

static double node[NODES], weight[NODES]; /* of Gauss and Legendre, on [0, 1] */

static void make_nodes(void)
{
    int i, j, pass;
    double sum = 0.0;
    for (i = 0; i < NODES; i++) {
        double x = cos(PI * (i + 0.75) / (NODES + 0.5)), slope = 1.0;
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
        node[i] = 0.5 * (1.0 + x);
        weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
        sum += weight[i];
    }
    CHECK_CLOSE(sum, 1.0, 1e-14);
}

enum { OF_W, OF_F, OF_SHAPE };

/* The integral of W dV or of r dW/dr dV over all space, or of the shape w dq over (0, support). Every piece between knots is smooth; the first one is
   integrated over s with q = s^2 / 6, which leaves polynomials polynomials and makes one of the square root. */
static double integral(int what, sph_kernel k, int dim, double h)
{
    const int parts = (int)(get_support(k) * PARTS + 0.5);
    double sum = 0.0;
    int part, i;
    for (part = 0; part < parts; part++)
        for (i = 0; i < NODES; i++) {
            const double s = node[i];
            const double q = part == 0 ? s * s / PARTS : (part + s) / PARTS;
            const double dq = weight[i] * (part == 0 ? 2.0 * s / PARTS : 1.0 / PARTS);
            const double r = rounded(q * h);
            if (what == OF_SHAPE) sum += dq * get_shape(k, dim, q);
            else if (what == OF_W) sum += dq * h * surface(dim) * power(r, dim - 1) * get_w(k, dim, r, h);
            else sum += dq * h * surface(dim) * power(r, dim + 1) * get_f(k, dim, r, h);
        }
    return sum;
}

static void test_normalisation(sph_kernel k, int dim)
{
    const double tolerance = BY_PRECISION(1e-13, 2e-6), h = 0.625, edge = get_support(k);
    /* by parts: the integral of r dW/dr is -dim, plus the jump of a truncated kernel at its edge */
    const double jump = is_truncated(k) ? get_sigma(k, dim) * surface(dim) * power(edge, dim) * get_shape(k, dim, edge * (1.0 - EPSILON)) : 0.0;
    NEAR("integral of W", 0.0, integral(OF_W, k, dim, 1.0), 1.0, tolerance);
    NEAR("integral of W, h = 0.625", 0.0, integral(OF_W, k, dim, h), 1.0, tolerance);
    NEAR("integral of r dW/dr", 0.0, integral(OF_F, k, dim, 1.0), jump - dim, tolerance);
    NEAR("integral of r dW/dr, h = 0.625", 0.0, integral(OF_F, k, dim, h), jump - dim, tolerance);
}

/* ---- derivatives ------------------------------------------------------------------------------------------------------------------------- */

/* Which derivative a central difference approximates. */
enum { DWDR_OF_W, D2WDR2_OF_DWDR, DWDH_OF_W };

static double central(int what, sph_kernel k, int dim, double r, double h, double step)
{
    /* the step that is really made, after rounding */
    const double x = what == DWDH_OF_W ? h : r, up = rounded(x + step), down = rounded(x - step), apart = up - down;
    if (what == DWDR_OF_W) return (get_w(k, dim, up, h) - get_w(k, dim, down, h)) / apart;
    if (what == D2WDR2_OF_DWDR) return (get_dwdr(k, dim, up, h) - get_dwdr(k, dim, down, h)) / apart;
    return (get_w(k, dim, r, up) - get_w(k, dim, r, down)) / apart;
}

static double difference(int what, sph_kernel k, int dim, double r, double h, double step)
{
    return (4.0 * central(what, k, dim, r, h, 0.5 * step) - central(what, k, dim, r, h, step)) / 3.0;
}

/* In the interior of each stretch of 1/6 of q. The error is that of step^4 and of rounding / step; together they were measured to reach a third of the tolerance
   in double, and half of it in float, where the step is too long for the square root near the origin. */
static void test_derivatives(sph_kernel k, int dim)
{
    const double normal_step = BY_PRECISION(5e-4, 1.0 / 64.0), tolerance = BY_PRECISION(2e-11, 2e-4), h = 1.25;
    const double scale = get_sigma(k, dim) / power(h, dim);
    const magnitude m = magnitude_of(k, dim);
    const int parts = (int)(get_support(k) * PARTS + 0.5);
    int part, i;
    for (part = SPH_SINGLE && k == SPH_SCHUESSLER_SCHMITT ? 3 : 0; part < parts; part++)
        for (i = 1; i <= 3; i++) {
            const double q = (part + 0.25 * i) / PARTS, r = rounded(q * h), step = part == 0 && k == SPH_SCHUESSLER_SCHMITT ? 0.25 * normal_step : normal_step;
            NEAR("dW/dr", q, get_dwdr(k, dim, r, h), difference(DWDR_OF_W, k, dim, r, h, step), tolerance * scale / h * (m.d1 + m.w));
            NEAR("d2W/dr2", q, get_d2wdr2(k, dim, r, h), difference(D2WDR2_OF_DWDR, k, dim, r, h, step), tolerance * scale / (h * h) * (m.d2 + m.d1));
            NEAR("dW/dh", q, get_dwdh(k, dim, r, h), difference(DWDH_OF_W, k, dim, r, h, step), tolerance * scale / h * dim * (m.d1 + m.w));
        }
}

/* W, F and their relatives, of the same r and h. */
static void test_consistency(sph_kernel k, int dim)
{
    static const double hs[] = {1.0, 0.5, 0.7, 12.3};
    const magnitude m = magnitude_of(k, dim);
    const double sigma = get_sigma(k, dim), edge = get_support(k);
    int i, j;
    for (j = 0; j < 4; j++)
        for (i = 0; i <= 40; i++) {
            const double h = rounded(hs[j]), r = rounded(edge * i / 38.0 * h), q = r / h;
            const double w = get_w(k, dim, r, h), f = get_f(k, dim, r, h), dwdr = get_dwdr(k, dim, r, h);
            const sph_wf both = sph_kernel_wf(k, dim, SPH_R(r), SPH_R(h));
            const double unit = sigma / power(h, dim);
            NEAR("W of both", q, (double)both.w, w, 4.0 * EPSILON * fabs(w));
            NEAR("F of both", q, (double)both.f, f, 4.0 * EPSILON * fabs(f));
            NEAR("r F = dW/dr", q, dwdr, r * f, EPSILON * fabs(dwdr));
            NEAR("dW/dh = -(dim W + r dW/dr) / h", q, get_dwdh(k, dim, r, h), -(dim * w + r * dwdr) / h, 8.0 * EPSILON * (dim * fabs(w) + fabs(r * dwdr)) / h);
            /* not on the edge, where rounding of r/h decides */
            if (i == 38) continue;
            NEAR("W of q", q, w, unit * get_shape(k, dim, q), 8.0 * EPSILON * unit * (m.w + m.d1));
            NEAR("F of q", q, f, unit / (h * h) * get_shape_f(k, dim, q), 16.0 * EPSILON * unit / (h * h) * (m.f + fabs(get_shape_f(k, dim, q))));
            NEAR("W(r, h) = W(r/h, 1) / h^dim", q, w, get_w(k, dim, q, 1.0) / power(h, dim), 8.0 * EPSILON * unit * (m.w + m.d1));
            NEAR("d2W/dr2 of q", q, get_d2wdr2(k, dim, r, h), unit / (h * h) * get_shape_d2(k, dim, q), 32.0 * EPSILON * unit / (h * h) * (m.d2 + m.f + fabs(get_shape_d2(k, dim, q))));
        }
}

/* ---- the origin and the edge ------------------------------------------------------------------------------------------------------------ */

static void test_origin(sph_kernel k, int dim)
{
    const magnitude m = magnitude_of(k, dim);
    const double small = BY_PRECISION(1e-4, 1e-2), at_0 = get_shape_f(k, dim, 0.0);
    /* the slope next to the origin, in units of w(0): of the order of 1 for a cusp, of q w''(0) / 2 < 6 q for all others */
    const double near_0 = 1e-3;
    const double slope = (get_shape(k, dim, 0.0) - get_shape(k, dim, near_0)) / (near_0 * get_shape(k, dim, 0.0));
    HOLDS("has a cusp exactly if the slope does not vanish", 0.0, sph_kernel_has_cusp(k) == (slope > 0.1));
    HOLDS("W(0) > 0", 0.0, get_w(k, dim, 0.0, 1.0) > 0.0);
    HOLDS("dW/dr(0) = 0", 0.0, get_dwdr(k, dim, 0.0, 0.75) == 0.0);
    if (sph_kernel_has_cusp(k)) {
        HOLDS("F(0) = 0 of a cusp", 0.0, get_f(k, dim, 0.0, 0.75) == 0.0);
        /* F itself is finite and negative however close a neighbour comes */
        HOLDS("F < 0 near a cusp", 1e-12, get_f(k, dim, 1e-12, 1.0) < 0.0 && fabs(get_f(k, dim, 1e-12, 1.0)) < 1e20);
    } else {
        /* de l'Hopital: (1/q) w' -> w'' */
        NEAR("F(0) = w''(0)", 0.0, at_0, get_shape_d2(k, dim, 0.0), 8.0 * EPSILON * m.f);
        /* F = F(0) + a q + b q^2: extrapolated to q = 0 from the neighbourhood, it is F(0) again */
        NEAR("limit of F", small, 2.0 * get_shape_f(k, dim, small) - get_shape_f(k, dim, 2.0 * small), at_0, BY_PRECISION(1e-6, 1e-2) * m.f);
        NEAR("F(0) next to the origin", small, get_shape_f(k, dim, small), at_0, 8.0 * small * m.f);
    }
}

/* With an h whose reciprocal is rounded, r = support h gives a q next to the support, on either side of it. What does not jump is 0 there up to rounding. */
static void test_rounded_edge(sph_kernel k, int dim)
{
    const magnitude m = magnitude_of(k, dim);
    int i;
    for (i = 1; i <= 200; i++) {
        const double h = rounded(0.37 + 0.013 * i), r = (double)sph_kernel_support(k, SPH_R(h)), unit = get_sigma(k, dim) / power(h, dim);
        const double w = get_w(k, dim, r, h), f = get_f(k, dim, r, h);
        if (!is_truncated(k)) HOLDS("W = 0 on the edge, up to rounding", r / h, fabs(w) <= 8.0 * EPSILON * unit * m.w);
        if (!is_truncated(k) && k != SPH_SCHUESSLER_SCHMITT) HOLDS("F = 0 on the edge, up to rounding", r / h, fabs(f) <= 8.0 * EPSILON * unit / (h * h) * (m.d1 + m.d2));
        HOLDS("nothing beyond the edge", r / h, get_w(k, dim, r * (1.0 + 4.0 * EPSILON), h) == 0.0 && get_f(k, dim, r * (1.0 + 4.0 * EPSILON), h) == 0.0);
    }
}

static void test_edge(sph_kernel k, int dim)
{
    static const double beyond[] = {1.0, 1.0001, 2.0, 10.0, 1e6, 1e9};
    static const double h[] = {1.0, 0.25, 8.0}; /* powers of two: r/h is exact. With others the edge itself is met up to rounding */
    const magnitude m = magnitude_of(k, dim);
    const double edge = get_support(k), inside = edge * (1.0 - 1e-5);
    int i, j;
    for (i = 0; i < 6; i++)
        for (j = 0; j < 3; j++) {
            /* 1e6 and 1e9 are q themselves */
            const double q = beyond[i] < 1e5 ? edge * beyond[i] : beyond[i], r = q * h[j];
            const sph_wf both = sph_kernel_wf(k, dim, SPH_R(r), SPH_R(h[j]));
            HOLDS("W = 0 outside", q, get_w(k, dim, r, h[j]) == 0.0);
            HOLDS("F = 0 outside", q, get_f(k, dim, r, h[j]) == 0.0);
            HOLDS("W, F = 0 outside", q, (double)both.w == 0.0 && (double)both.f == 0.0);
            HOLDS("dW/dr = 0 outside", q, get_dwdr(k, dim, r, h[j]) == 0.0);
            HOLDS("d2W/dr2 = 0 outside", q, get_d2wdr2(k, dim, r, h[j]) == 0.0);
            HOLDS("dW/dh = 0 outside", q, get_dwdh(k, dim, r, h[j]) == 0.0);
        }
    HOLDS("W != 0 inside", 0.999 * edge, get_w(k, dim, 0.999 * edge, 1.0) != 0.0);

    if (is_truncated(k)) { /* jumps by exp(-9), times the factor of the super-Gaussian */
        const double q = edge * (1.0 - EPSILON), factor = k == SPH_GAUSSIAN ? 1.0 : 0.5 * dim + 1.0 - q * q;
        NEAR("jump at the edge", q, get_shape(k, dim, q), factor * exp(-9.0), 64.0 * EPSILON * exp(-9.0) * fabs(factor));
        HOLDS("the slope jumps", q, fabs(get_shape_f(k, dim, q)) > 2e-4);
    } else {
        NEAR("continuous at the edge", inside, get_shape(k, dim, inside), 0.0, 4e-5 * m.w);
        if (k == SPH_SCHUESSLER_SCHMITT) /* -1 / (2 sqrt 2) */
            NEAR("slope at the edge", inside, inside * get_shape_f(k, dim, inside), -0.35355339059327376, 1e-5);
        else
            NEAR("no slope at the edge", inside, inside * get_shape_f(k, dim, inside), 0.0, 4e-5 * m.d2);
    }
    HOLDS("the curvature jumps exactly where it is said to", inside, (fabs(get_shape_d2(k, dim, inside)) > 1e-3) == curvature_jumps(k));
}

/* ---- signs -------------------------------------------------------------------------------------------------------------------------------- */

static void test_signs(sph_kernel k, int dim)
{
    const int n = 3000;
    const double edge = get_support(k), scale = magnitude_of(k, dim).d2;
    int i, positive = 1, falling = 1;
    double lowest = scale;
    for (i = 0; i < n; i++) {
        const double q = edge * (i + 0.5) / n, w = get_shape(k, dim, q), f = get_shape_f(k, dim, q), d2 = get_shape_d2(k, dim, q);
        if (w < 0.0) positive = 0;
        if (f > 0.0) falling = 0;
        if (d2 < lowest) lowest = d2;
        if (k == SPH_LIU_QUARTIC) {
            if (fabs(q - 1.6957) > 1e-4) HOLDS("negative exactly for 1.6957 < q < 2", q, (w < 0.0) == (q > 1.6957));
            HOLDS("rises exactly for 1.8 < q < 2", q, (f > 0.0) == (q > 1.8));
        } else if (k == SPH_SUPER_GAUSSIAN) {
            HOLDS("negative exactly beyond q^2 = dim/2 + 1", q, (w < 0.0) == (q * q > 0.5 * dim + 1.0));
            HOLDS("rises exactly beyond q^2 = dim/2 + 2", q, (f > 0.0) == (q * q > 0.5 * dim + 2.0));
        }
    }
    {
        const int ordinary = k != SPH_LIU_QUARTIC && k != SPH_SUPER_GAUSSIAN;
        HOLDS("W >= 0 for all but liu-quartic and super-gaussian", 0.0, positive == ordinary);
        HOLDS("dW/dr <= 0 for all but liu-quartic and super-gaussian", 0.0, falling == ordinary);
        HOLDS("may be convexified unless liu-quartic or super-gaussian", 0.0, sph_kernel_may_convexify(k, dim) == ordinary);
    }
    if (is_convex(k)) HOLDS("convex", 0.0, lowest >= -32.0 * EPSILON * scale);
    else HOLDS("not convex", 0.0, lowest < -0.1 * scale);

    if (k == SPH_CORE_TRIANGLE) /* straight in the core: the slope is -1 there */
        for (i = 1; i < 40; i++) {
            const double q = i / 60.0;
            NEAR("slope in the core", q, rounded(q) * get_shape_f(k, dim, q), -1.0, 16.0 * EPSILON);
            NEAR("curvature in the core", q, get_shape_d2(k, dim, q), 0.0, 16.0 * EPSILON);
        }
}

/* ---- relations between kernels, and printed formulas ------------------------------------------------------------------------------------ */

static void test_convexified(void)
{
    static const sph_kernel pair[4][2] = {{SPH_CONVEX, SPH_HERMITE},
                                          {SPH_CONVEX_CUBIC_SPLINE, SPH_CUBIC_SPLINE},
                                          {SPH_CONVEX_WENDLAND_C2, SPH_WENDLAND_C2},
                                          {SPH_CONVEX_WENDLAND_C4, SPH_WENDLAND_C4}};
    int i, j, dim;
    for (j = 0; j < 4; j++)
        for (dim = 1; dim <= 3; dim++) {
            const sph_kernel k = pair[j][0], from = pair[j][1];
            const double at_0 = k == SPH_CONVEX ? 8.0 : 1.0, factor = at_0 / integral(OF_SHAPE, from, dim, 1.0);
            NEAR("K(0)", 0.0, get_shape(k, dim, 0.0), at_0, 2.0 * EPSILON * at_0);
            for (i = 1; i <= 40; i++) {
                const double q = rounded(0.05 * i), w = get_shape(from, dim, q);
                NEAR("K' = -w K(0) / integral of w", q, q * get_shape_f(k, dim, q), -factor * w, 16.0 * EPSILON * factor * get_shape(from, dim, 0.0));
            }
        }
}

static void test_printed_formulas(void)
{
    /* the normalisations as the papers print them, for 1, 2 and 3 dimensions, of shapes that are w there times a power of two */
    static const double lucy[3] = {5.0 / 64.0, 5.0 / (32.0 * PI), 105.0 / (1024.0 * PI)};
    static const double convex[3] = {5.0 / 48.0, 15.0 / (64.0 * PI), 21.0 / (128.0 * PI)};
    int i, dim;
    for (dim = 1; dim <= 3; dim++) {
        CHECK_RELATIVE(get_sigma(SPH_WENDLAND_C2_1D, dim), 8.0 * lucy[dim - 1], 2.0 * EPSILON);
        CHECK_RELATIVE(get_sigma(SPH_CONVEX, dim), convex[dim - 1], 2.0 * EPSILON);
    }
    for (i = 0; i <= 20; i++) {
        const double q = rounded(0.1 * i), a = q < 2.0 ? 2.0 - q : 0.0, h = 0.75;
        for (dim = 1; dim <= 3; dim++) {
            const sph_kernel k = SPH_WENDLAND_C2_1D;
            NEAR("(1.1) of the clustering paper", q, get_w(k, dim, q, 1.0), lucy[dim - 1] * power(a, 3) * (1.5 * q + 1.0), 16.0 * EPSILON * get_sigma(k, dim));
        }
        for (dim = 1; dim <= 3; dim++) {
            const sph_kernel k = SPH_CONVEX;
            NEAR("(3.9) of the clustering paper", q, get_w(k, dim, q, 1.0), convex[dim - 1] * power(a, 3) * (0.5 * q + 1.0), 64.0 * EPSILON * get_sigma(k, dim));
        }
        {
            const sph_kernel k = SPH_WENDLAND_C4_1D;
            dim = 1;
            NEAR("the kernel of the ICSPM paper", q, get_w(k, 1, rounded(q * h), h), 3.0 / (128.0 * h) * power(a, 5) * (2.0 * q * q + 2.5 * q + 1.0),
                 16.0 * EPSILON * get_sigma(k, 1) / h);
        }
    }
}

/* The polynomial next to the origin is never the difference of large numbers divided by a small one. */
static void test_no_cancellation(void)
{
    const double tolerance = BY_PRECISION(1e-14, 2e-6);
    double x;
    for (x = 1e-9; x < 0.1; x *= 1.37) {
        const double q = rounded(x);
        CHECK_RELATIVE(get_shape_f(SPH_CUBIC_SPLINE, 3, q), -3.0 + 2.25 * q, tolerance);
        CHECK_RELATIVE(get_shape_f(SPH_QUARTIC_SPLINE, 3, q), 24.0 * q * q - 30.0, tolerance);
        CHECK_RELATIVE(get_shape_f(SPH_QUINTIC_SPLINE, 3, q), -120.0 + q * q * (120.0 - 50.0 * q), tolerance);
    }
}

/* ---- a lattice ---------------------------------------------------------------------------------------------------------------------------- */

/* How far a sum over a hexagonal lattice of spacing 1 is from the integral: of W (should be 1) and of -r dW/dr / 2 (should be 1). */
static void test_lattice(void)
{
    static const struct {
        sph_kernel k;
        double h, w, f;
    } expected[] = {{SPH_WENDLAND_C2_1D, 1.5, 0.00033, -0.00761}, {SPH_WENDLAND_C2_1D, 2.0, -0.00003, 0.00061},
                    {SPH_CONVEX, 1.5, 0.03201, -0.02146},         {SPH_CONVEX, 2.0, 0.01343, -0.00628},
                    {SPH_HERMITE, 1.5, -0.00231, 0.00487},        {SPH_WENDLAND_C2, 1.5, 0.00368, -0.00803}};
    const double volume = 0.86602540378443864676;
    const int dim = 2;
    int n, i, j;
    for (n = 0; n < 6; n++) {
        const sph_kernel k = expected[n].k;
        const double h = expected[n].h;
        double sum_w = 0.0, sum_f = 0.0;
        for (j = -6; j <= 6; j++)
            for (i = -9; i <= 9; i++) {
                const double x = i + 0.5 * j, y = volume * j, r = rounded(sqrt(x * x + y * y));
                sum_w += volume * get_w(k, dim, r, h);
                sum_f -= 0.5 * volume * r * get_dwdr(k, dim, r, h);
            }
        /* 1e-5 also covers that the values above are rounded to five digits */
        NEAR("sum of V W - 1 on a hexagonal lattice", h, sum_w - 1.0, expected[n].w, 1e-5);
        NEAR("sum of -V r dW/dr / 2 - 1 on a hexagonal lattice", h, sum_f - 1.0, expected[n].f, 1e-5);
    }
}

/* ---- tables and names --------------------------------------------------------------------------------------------------------------------- */

static sph_kernel kernel_from_switch(int k)
{
    sph_kernel found = SPH_KERNEL_COUNT;
#define TEST_SWITCH(K) found = K
    SPH_SWITCH_KERNEL(k, TEST_SWITCH)
#undef TEST_SWITCH
    return found;
}

static void test_table(sph_kernel k)
{
    const double support = k == SPH_QUARTIC_SPLINE ? 2.5 : k == SPH_QUINTIC_SPLINE || is_truncated(k) ? 3.0 : 2.0;
    const double h = 0.3;
    const int dim = 0;
    HOLDS("support", 0.0, get_support(k) == support);
    HOLDS("h / dx", 0.0, (double)sph_kernel_h_over_dx(k) >= 1.0 && (double)sph_kernel_h_over_dx(k) <= 2.0);
    NEAR("support from h", 0.0, (double)sph_kernel_support(k, SPH_R(h)), support * h, 2.0 * EPSILON);
    NEAR("h from support", 0.0, (double)sph_kernel_h_from_support(k, SPH_R(support * h)), h, 2.0 * EPSILON);
    NEAR("h from support from h", 0.0, (double)sph_kernel_h_from_support(k, sph_kernel_support(k, SPH_R(h))), h, 2.0 * EPSILON);
    HOLDS("dispatch of a kernel known at run time", 0.0, kernel_from_switch((int)k) == k);
}

static void test_names(void)
{
    static const struct {
        const char *name;
        sph_kernel k;
    } known[] = {{"m4", SPH_CUBIC_SPLINE},
                 {"M4", SPH_CUBIC_SPLINE},
                 {"cubic", SPH_CUBIC_SPLINE},
                 {"Cubic Spline", SPH_CUBIC_SPLINE},
                 {"m5", SPH_QUARTIC_SPLINE},
                 {"quartic", SPH_QUARTIC_SPLINE},
                 {"M6", SPH_QUINTIC_SPLINE},
                 {"quintic", SPH_QUINTIC_SPLINE},
                 {"wendland", SPH_WENDLAND_C2},
                 {"Wendland_C2", SPH_WENDLAND_C2},
                 {"wendland c2", SPH_WENDLAND_C2},
                 {"WENDLAND-C2", SPH_WENDLAND_C2},
                 {"WendlandC2", SPH_WENDLAND_C2},
                 {"w2", SPH_WENDLAND_C2},
                 {"c2", SPH_WENDLAND_C2},
                 {"W4", SPH_WENDLAND_C4},
                 {"C4", SPH_WENDLAND_C4},
                 {"wendlandc4", SPH_WENDLAND_C4},
                 {"w6", SPH_WENDLAND_C6},
                 {"c6", SPH_WENDLAND_C6},
                 {"wendlandc6", SPH_WENDLAND_C6},
                 {"lucy", SPH_WENDLAND_C2_1D},
                 {"Lucy", SPH_LUCY},
                 {"w2-1d", SPH_WENDLAND_C2_1D},
                 {"W4_1D", SPH_WENDLAND_C4_1D},
                 {"w6 1d", SPH_WENDLAND_C6_1D},
                 {"gauss", SPH_GAUSSIAN},
                 {"supergaussian", SPH_SUPER_GAUSSIAN},
                 {"super_gaussian", SPH_SUPER_GAUSSIAN},
                 {"liu", SPH_LIU_QUARTIC},
                 {"read", SPH_CORE_TRIANGLE},
                 {"CT", SPH_CORE_TRIANGLE},
                 {"convex_wendland_c4", SPH_CONVEX_WENDLAND_C4}};
    static const char *const unknown[] = {"",    " ",       "-",         "m",      "m7",          "cubic-",         "-cubic",          "cubic-splin", "cubic-spline ",
                                          "0",   "wendland-c", "wendland-c2-", "convex-", "convex-hermite", "unknown kernel", "wendland--c2", "cubicspline-"};
    size_t i;
    int k, other;
    for (k = 0; k < SPH_KERNEL_COUNT; k++) {
        const char *name = sph_kernel_name((sph_kernel)k);
        CHECK(name[0] != '\0');
        CHECK(sph_kernel_from_name(name) == k);
        for (other = 0; other < k; other++) CHECK(strcmp(name, sph_kernel_name((sph_kernel)other)) != 0);
    }
    for (i = 0; i < sizeof known / sizeof known[0]; i++)
        if (!check_count(sph_kernel_from_name(known[i].name) == (int)known[i].k)) fprintf(stderr, "test_kernels.c: failed: name '%s'\n", known[i].name);
    for (i = 0; i < sizeof unknown / sizeof unknown[0]; i++)
        if (!check_count(sph_kernel_from_name(unknown[i]) == -1)) fprintf(stderr, "test_kernels.c: failed: '%s' is no name\n", unknown[i]);
    CHECK(sph_kernel_from_name(NULL) == -1);
    CHECK(strcmp(sph_kernel_name(SPH_KERNEL_COUNT), "unknown kernel") == 0);
    CHECK(SPH_KERNEL_COUNT == 20);
}

static void test_status_texts(void)
{
    const char *unknown = sph_status_text(SPH_LIST_TOO_SHORT + 1);
    int a, b;
    for (a = SPH_ERROR_PAIRS; a <= SPH_LIST_TOO_SHORT; a++) {
        CHECK(sph_status_text(a)[0] != '\0');
        CHECK(strcmp(sph_status_text(a), unknown) != 0);
        for (b = SPH_ERROR_PAIRS; b < a; b++) CHECK(strcmp(sph_status_text(a), sph_status_text(b)) != 0);
    }
    CHECK(strcmp(sph_status_text(SPH_ERROR_PAIRS - 1), unknown) == 0);
    CHECK(strcmp(sph_status_text(SPH_OK), "ok") == 0);
}

static void test_no_kernel(void)
{
    const sph_kernel k = SPH_KERNEL_COUNT;
    CHECK(get_support(k) == 0.0);
    CHECK((double)sph_kernel_h_over_dx(k) == 0.0);
    CHECK(get_sigma(k, 3) == 0.0);
    CHECK(get_shape(k, 3, 0.5) == 0.0);
    CHECK(get_shape_f(k, 3, 0.5) == 0.0);
    CHECK(get_shape_d2(k, 3, 0.5) == 0.0);
    CHECK(get_w(k, 3, 0.5, 1.0) == 0.0);
    CHECK(get_f(k, 3, 0.5, 1.0) == 0.0);
    CHECK(kernel_from_switch(-1) == SPH_KERNEL_COUNT);
}

int main(void)
{
    int i, dim;
    make_nodes();
    for (i = 0; i < SPH_KERNEL_COUNT; i++) {
        const sph_kernel k = (sph_kernel)i;
        for (dim = 1; dim <= 3; dim++) {
            test_normalisation(k, dim);
            test_derivatives(k, dim);
            test_consistency(k, dim);
            test_origin(k, dim);
            test_edge(k, dim);
            test_rounded_edge(k, dim);
            test_signs(k, dim);
        }
        test_table(k);
    }
    test_convexified();
    test_printed_formulas();
    test_no_cancellation();
    test_lattice();
    test_names();
    test_status_texts();
    test_no_kernel();
    return check_report("test_kernels");
}
