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
           k == SPH_CONVEX_WENDLAND_C2 || k == SPH_CONVEX_WENDLAND_C4 || k == SPH_CORE_TRIANGLE || k == SPH_SPIKY;
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
    const double least = BY_PRECISION(0.0, 1.5e-45); /* next to the edge, M7 and M8 in float are numbers so small that they have no relative accuracy */
    int i, j;
    for (j = 0; j < 4; j++)
        for (i = 0; i <= 40; i++) {
            const double h = rounded(hs[j]), r = rounded(edge * i / 38.0 * h), q = r / h;
            const double w = get_w(k, dim, r, h), f = get_f(k, dim, r, h), dwdr = get_dwdr(k, dim, r, h);
            const sph_wf both = sph_kernel_wf(k, dim, SPH_R(r), SPH_R(h));
            const double unit = sigma / power(h, dim);
            NEAR("W of both", q, (double)both.w, w, 4.0 * EPSILON * fabs(w));
            NEAR("F of both", q, (double)both.f, f, 4.0 * EPSILON * fabs(f));
            NEAR("r F = dW/dr", q, dwdr, r * f, EPSILON * fabs(dwdr) + least);
            NEAR("dW/dh = -(dim W + r dW/dr) / h", q, get_dwdh(k, dim, r, h), -(dim * w + r * dwdr) / h, 8.0 * EPSILON * (dim * fabs(w) + fabs(r * dwdr)) / h + least * (2.0 + r * r / h));
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

/* Mueller, Charypar & Gross 2003 as everybody prints them: h is the radius of the support, in 3D; in 2D 4/(pi h^8) and 10/(pi h^5). */
static void test_mueller(void)
{
    const double H = 0.8125, h6 = (double)sph_kernel_h_from_support(SPH_POLY6, SPH_R(H)), hs = (double)sph_kernel_h_from_support(SPH_SPIKY, SPH_R(H));
    const double poly6 = 315.0 / (64.0 * PI * power(H, 9)), spiky = 15.0 / (PI * power(H, 6));
    const double at_0 = poly6 * power(H, 6), slope_0 = poly6 * power(H, 4);
    int i, dim = 3;
    for (i = 1; i <= 16; i++) {
        const double r = rounded(H * i / 16.0), d = H * H - r * r;
        sph_kernel k = SPH_POLY6;
        NEAR("poly6", r / H, get_w(k, 3, r, h6), poly6 * power(d, 3), 16.0 * EPSILON * at_0);
        NEAR("gradient of poly6", r / H, get_f(k, 3, r, h6), -6.0 * poly6 * power(d, 2), 64.0 * EPSILON * slope_0);
        NEAR("Laplacian of poly6", r / H, get_d2wdr2(k, 3, r, h6) + 2.0 * get_f(k, 3, r, h6), -6.0 * poly6 * d * (3.0 * H * H - 7.0 * r * r), 256.0 * EPSILON * slope_0);
        NEAR("poly6 in 2D", r / H, get_w(k, 2, r, h6), 4.0 / (PI * power(H, 8)) * power(d, 3), 16.0 * EPSILON * at_0);
        k = SPH_SPIKY;
        NEAR("spiky", r / H, get_w(k, 3, r, hs), spiky * power(H - r, 3), 16.0 * EPSILON * spiky * power(H, 3));
        NEAR("gradient of spiky", r / H, get_dwdr(k, 3, r, hs), -3.0 * spiky * power(H - r, 2), 16.0 * EPSILON * spiky * power(H, 2));
        NEAR("spiky in 2D", r / H, get_w(k, 2, r, hs), 10.0 / (PI * power(H, 5)) * power(H - r, 3), 16.0 * EPSILON * spiky * power(H, 3));
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
        CHECK_RELATIVE(get_shape_f(SPH_SEXTIC_SPLINE, 3, q), -577.5 + q * q * (420.0 - 120.0 * q * q), tolerance);
        CHECK_RELATIVE(get_shape_f(SPH_HEPTIC_SPLINE, 3, q), -3360.0 + q * q * (2240.0 - q * q * (840.0 - 245.0 * q)), tolerance);
        /* of M7 and M8 the values and curvatures, too */
        CHECK_RELATIVE(get_shape(SPH_SEXTIC_SPLINE, 3, q), 367.9375 - q * q * (288.75 - q * q * (105.0 - 20.0 * q * q)), tolerance);
        CHECK_RELATIVE(get_shape(SPH_HEPTIC_SPLINE, 3, q), 2416.0 - q * q * (1680.0 - q * q * (560.0 - q * q * (140.0 - 35.0 * q))), tolerance);
        CHECK_RELATIVE(get_shape_d2(SPH_SEXTIC_SPLINE, 3, q), -577.5 + q * q * (1260.0 - 600.0 * q * q), tolerance);
        CHECK_RELATIVE(get_shape_d2(SPH_HEPTIC_SPLINE, 3, q), -3360.0 + q * q * (6720.0 - q * q * (4200.0 - 1470.0 * q)), tolerance);
    }
}

/* ---- cohesion and adhesion --------------------------------------------------------------------------------------------------------------- */

static double get_cohesion(double r, double support) { return (double)sph_cohesion_kernel_akinci(SPH_R(r), SPH_R(support)); }
static double get_adhesion(double r, double support) { return (double)sph_adhesion_kernel_akinci(SPH_R(r), SPH_R(support)); }

static void test_akinci(void)
{
    static const double supports[] = {1.0, 0.0625, 0.7, 12.5};
    const double beta = tgamma(1.25) * tgamma(1.25) / tgamma(2.5), tiny = BY_PRECISION(1e-9, 1e-4);
    double cohesion = 0.0, adhesion = 0.0;
    int i, j, part;
    for (j = 0; j < 4; j++) {
        const double H = rounded(supports[j]), unit = 1.0 / power(H, 3), largest = 0.5 / PI * unit;
        for (i = 0; i <= 80; i++) {
            /* as the paper prints them; H is its h. At the ends of A the fourth root magnifies a rounding error in its argument. */
            const double r = rounded(H * i / 64.0), x = r / H, a = -4.0 * r * r / H + 6.0 * r - 2.0 * H;
            const double far_ = 32.0 / (PI * power(H, 9)) * power(H - r, 3) * power(r, 3);
            const double close = 2.0 * far_ - 32.0 / (PI * power(H, 9)) * power(H, 6) / 64.0;
            const double c = x > 1.0 ? 0.0 : x > 0.5 ? far_ : close;
            const double want = x > 0.5 && x < 1.0 && a > 0.0 ? 0.007 / pow(H, 3.25) * pow(a, 0.25) : 0.0;
            CHECK_CLOSE(get_cohesion(r, H), c, 16.0 * EPSILON * largest);
            CHECK_CLOSE(get_adhesion(r, H), want, (x > 0.51 && x < 0.99 ? 64.0 * EPSILON : pow(16.0 * EPSILON, 0.25)) * 0.007 * unit);
        }
        CHECK_RELATIVE(get_cohesion(0.0, H), -largest, 8.0 * EPSILON);
        CHECK_RELATIVE(get_cohesion(0.5 * H, H), largest, 8.0 * EPSILON);
        CHECK_CLOSE(get_cohesion(0.5 * H * (1.0 - tiny), H), get_cohesion(0.5 * H * (1.0 + tiny), H), 8.0 * EPSILON * largest);
        CHECK(get_cohesion(0.2728 * H, H) < 0.0 && get_cohesion(0.2730 * H, H) > 0.0);
        CHECK_RELATIVE(get_adhesion(0.75 * H, H), 0.007 * sqrt(0.5) * unit, 8.0 * EPSILON);
        CHECK(get_adhesion(0.0, H) == 0.0 && get_adhesion(0.5 * H, H) == 0.0);
        for (i = 0; i < 4; i++) {
            const double r = i == 0 ? H * (1.0 + 4.0 * EPSILON) : H * power(1000.0, i);
            CHECK(get_cohesion(r, H) == 0.0 && get_adhesion(r, H) == 0.0);
        }
    }
    /* over all space: 79/336, and 0.007 pi/2 (9/4 + 1/14) B(5/4, 5/4) = 0.01578. The fourth root is smooth in s, where x = 1/2 + s^4 / 4 or 1 - s^4 / 4. */
    for (part = 0; part < 2; part++)
        for (i = 0; i < NODES; i++) {
            const double s = node[i], x = 0.5 * (part + s), y = 0.25 * power(s, 4), z = part ? 1.0 - y : 0.5 + y;
            cohesion += 0.5 * weight[i] * surface(3) * x * x * get_cohesion(x, 1.0);
            adhesion += power(s, 3) * weight[i] * surface(3) * z * z * get_adhesion(z, 1.0);
        }
    CHECK_RELATIVE(cohesion, 79.0 / 336.0, BY_PRECISION(1e-14, 1e-6));
    CHECK_RELATIVE(adhesion, 0.0035 * PI * 65.0 / 28.0 * beta, BY_PRECISION(1e-12, 1e-5));
    CHECK_CLOSE(adhesion, 0.01578, 5e-6);
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

/* What the header and examples/OPERATORS.md say of each kernel: the density of a lattice of spacing 1 in 1, 2 and 3 dimensions, at the recommended h. */
static void test_lattice_density(void)
{
    static const struct {
        sph_kernel k;
        double rho[3];
    } expected[] = {{SPH_CUBIC_SPLINE, {1.002, 1.000, 1.001}},        {SPH_QUARTIC_SPLINE, {1.000, 1.000, 0.999}},
                    {SPH_QUINTIC_SPLINE, {1.000, 1.000, 1.000}},      {SPH_WENDLAND_C2, {1.010, 1.010, 1.010}},
                    {SPH_WENDLAND_C4, {1.003, 1.003, 1.003}},         {SPH_WENDLAND_C6, {1.001, 1.002, 1.002}},
                    {SPH_WENDLAND_C2_1D, {1.002, 1.000, 0.998}},      {SPH_WENDLAND_C4_1D, {1.001, 1.000, 1.000}},
                    {SPH_WENDLAND_C6_1D, {1.000, 1.001, 1.001}},      {SPH_GAUSSIAN, {1.000, 1.000, 1.000}},
                    {SPH_SUPER_GAUSSIAN, {1.002, 1.003, 1.007}},      {SPH_LIU_QUARTIC, {1.004, 1.008, 1.015}},
                    {SPH_HERMITE, {1.000, 1.002, 1.004}},             {SPH_SCHUESSLER_SCHMITT, {1.106, 1.041, 1.006}},
                    {SPH_JOHNSON_BEISSEL, {1.056, 1.034, 1.019}},     {SPH_CONVEX, {1.063, 1.042, 1.023}},
                    {SPH_CONVEX_CUBIC_SPLINE, {1.108, 1.088, 1.058}}, {SPH_CONVEX_WENDLAND_C2, {1.134, 1.118, 1.083}},
                    {SPH_CONVEX_WENDLAND_C4, {1.174, 1.176, 1.142}},  {SPH_CORE_TRIANGLE, {1.051, 1.034, 1.018}},
                    {SPH_SEXTIC_SPLINE, {1.000, 1.000, 1.000}},       {SPH_HEPTIC_SPLINE, {1.000, 1.000, 1.000}},
                    {SPH_POLY6, {1.008, 1.015, 1.010}},               {SPH_SPIKY, {1.250, 1.274, 1.236}}};
    size_t n;
    int dim, x, y, z;
    CHECK(sizeof expected / sizeof expected[0] == SPH_KERNEL_COUNT);
    for (n = 0; n < sizeof expected / sizeof expected[0]; n++)
        for (dim = 1; dim <= 3; dim++) {
            const sph_kernel k = expected[n].k;
            const double h = (double)sph_kernel_h_over_dx(k);
            double rho = 0.0;
            CHECK((size_t)k == n);
            for (z = dim > 2 ? -4 : 0; z <= (dim > 2 ? 4 : 0); z++)
                for (y = dim > 1 ? -4 : 0; y <= (dim > 1 ? 4 : 0); y++)
                    for (x = -4; x <= 4; x++) rho += get_w(k, dim, sqrt((double)(x * x + y * y + z * z)), h);
            NEAR("density of a lattice", h, rho, expected[n].rho[dim - 1], 0.0005 + BY_PRECISION(1e-12, 1e-5));
            HOLDS("without a cusp within 1.6 %", h, sph_kernel_has_cusp(k) || fabs(rho - 1.0) < 0.016);
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
    const double support = k == SPH_QUARTIC_SPLINE                          ? 2.5
                           : k == SPH_QUINTIC_SPLINE || is_truncated(k) ? 3.0
                           : k == SPH_SEXTIC_SPLINE                     ? 3.5
                           : k == SPH_HEPTIC_SPLINE                     ? 4.0
                                                                        : 2.0;
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
                 {"convex_wendland_c4", SPH_CONVEX_WENDLAND_C4},
                 {"convexwendlandc4", SPH_CONVEX_WENDLAND_C4},
                 {"sextic", SPH_SEXTIC_SPLINE},
                 {"septic", SPH_HEPTIC_SPLINE},
                 {"HepticSpline", SPH_HEPTIC_SPLINE},
                 {"kernel_cubic", SPH_CUBIC_SPLINE},
                 {"Lucy kernel", SPH_LUCY},
                 /* Phantom, and ndspmhd */
                 {"cubic", SPH_CUBIC_SPLINE},
                 {"quartic", SPH_QUARTIC_SPLINE},
                 {"quintic", SPH_QUINTIC_SPLINE},
                 {"WendlandC2", SPH_WENDLAND_C2},
                 {"WendlandC4", SPH_WENDLAND_C4},
                 {"WendlandC6", SPH_WENDLAND_C6},
                 {"M_4 cubic", SPH_CUBIC_SPLINE},
                 {"M_5 quartic", SPH_QUARTIC_SPLINE},
                 {"M_6 quintic", SPH_QUINTIC_SPLINE},
                 {"M_8 heptic", SPH_HEPTIC_SPLINE},
                 /* Shamrock */
                 {"M4", SPH_CUBIC_SPLINE},
                 {"M5", SPH_QUARTIC_SPLINE},
                 {"M6", SPH_QUINTIC_SPLINE},
                 {"M7", SPH_SEXTIC_SPLINE},
                 {"M8", SPH_HEPTIC_SPLINE},
                 {"C2", SPH_WENDLAND_C2},
                 {"C4", SPH_WENDLAND_C4},
                 {"C6", SPH_WENDLAND_C6},
                 /* SWIFT */
                 {"cubic-spline", SPH_CUBIC_SPLINE},
                 {"quartic-spline", SPH_QUARTIC_SPLINE},
                 {"quintic-spline", SPH_QUINTIC_SPLINE},
                 {"wendland-C2", SPH_WENDLAND_C2},
                 {"wendland-C4", SPH_WENDLAND_C4},
                 {"wendland-C6", SPH_WENDLAND_C6},
                 /* PySPH */
                 {"CubicSpline", SPH_CUBIC_SPLINE},
                 {"QuinticSpline", SPH_QUINTIC_SPLINE},
                 {"Gaussian", SPH_GAUSSIAN},
                 {"SuperGaussian", SPH_SUPER_GAUSSIAN},
                 {"WendlandQuintic", SPH_WENDLAND_C2},
                 {"WendlandQuinticC2_1D", SPH_WENDLAND_C2_1D},
                 {"WendlandQuinticC4", SPH_WENDLAND_C4},
                 {"WendlandQuinticC4_1D", SPH_WENDLAND_C4_1D},
                 {"WendlandQuinticC6", SPH_WENDLAND_C6},
                 {"WendlandQuinticC6_1D", SPH_WENDLAND_C6_1D},
                 /* SPHinXsys */
                 {"CubicBSpline", SPH_CUBIC_SPLINE},
                 {"KernelCubicBSpline", SPH_CUBIC_SPLINE},
                 {"Wendland2CKernel", SPH_WENDLAND_C2},
                 {"KernelWendlandC2", SPH_WENDLAND_C2},
                 {"QuadraticKernel", SPH_JOHNSON_BEISSEL},
                 {"KernelQuadratic", SPH_JOHNSON_BEISSEL},
                 /* DualSPHysics */
                 {"Cubic", SPH_CUBIC_SPLINE},
                 {"Wendland", SPH_WENDLAND_C2},
                 /* TrixiParticles */
                 {"SchoenbergCubicSplineKernel", SPH_CUBIC_SPLINE},
                 {"SchoenbergQuarticSplineKernel", SPH_QUARTIC_SPLINE},
                 {"SchoenbergQuinticSplineKernel", SPH_QUINTIC_SPLINE},
                 {"WendlandC2Kernel", SPH_WENDLAND_C2},
                 {"WendlandC4Kernel", SPH_WENDLAND_C4},
                 {"WendlandC6Kernel", SPH_WENDLAND_C6},
                 {"GaussianKernel", SPH_GAUSSIAN},
                 {"Poly6Kernel", SPH_POLY6},
                 {"SpikyKernel", SPH_SPIKY},
                 /* OpenSPH */
                 {"cubic_spline", SPH_CUBIC_SPLINE},
                 {"fourth_order_spline", SPH_QUARTIC_SPLINE},
                 {"FourthOrderSpline", SPH_QUARTIC_SPLINE},
                 {"gaussian", SPH_GAUSSIAN},
                 {"core_triangle", SPH_CORE_TRIANGLE},
                 {"CoreTriangle", SPH_CORE_TRIANGLE},
                 {"wendland_c2", SPH_WENDLAND_C2},
                 {"wendland_c4", SPH_WENDLAND_C4},
                 {"wendland_c6", SPH_WENDLAND_C6},
                 {"Poly6", SPH_POLY6},
                 /* SPlisHSPlasH */
                 {"Cubic spline", SPH_CUBIC_SPLINE},
                 {"Precomputed cubic spline", SPH_CUBIC_SPLINE},
                 {"Cubic spline 2D", SPH_CUBIC_SPLINE},
                 {"Wendland quintic C2", SPH_WENDLAND_C2},
                 {"Wendland quintic C2 2D", SPH_WENDLAND_C2},
                 {"Spiky", SPH_SPIKY},
                 {"CubicKernel", SPH_CUBIC_SPLINE},
                 {"CubicKernel2D", SPH_CUBIC_SPLINE},
                 {"WendlandQuinticC2Kernel", SPH_WENDLAND_C2},
                 {"WendlandQuinticC2Kernel2D", SPH_WENDLAND_C2},
                 /* Spheral */
                 {"BSplineKernel", SPH_CUBIC_SPLINE},
                 {"QuinticSplineKernel", SPH_QUINTIC_SPLINE},
                 {"SuperGaussianKernel", SPH_SUPER_GAUSSIAN}};
    /* the last ones are kernels of other codes: not here, or not what the name says */
    static const char *const unknown[] = {
        "", " ", "-", "m", "m9", "cubic-", "-cubic", "cubic-splin", "cubic-spline ", "0", "wendland-c", "wendland-c2-", "convex-", "convex-hermite", "unknown kernel",
        "wendland--c2", "cubicspline-", "kernel", "kernel-", "kernel kernel", "-kernel", "cubic--kernel", "cubic kernel kernel", "cubic kernels", "kernel--cubic",
        "QuarticSplineKernel", "quartic spline kernel", "kernel quartic spline kernel", "W4SplineKernel", "NBSplineKernel", "PiGaussianKernel", "HatKernel", "SincKernel",
        "NSincPolynomialKernel", "ExpInvKernel", "triangle", "thomas_couchman", "KernelHyperbolic", "LaguerreGaussKernel", "M9", "M4DH", "CohesionKernel", "AdhesionKernel"};
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
    CHECK(SPH_KERNEL_COUNT == 24);
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
    test_mueller();
    test_no_cancellation();
    test_akinci();
    test_lattice();
    test_lattice_density();
    test_names();
    test_status_texts();
    test_no_kernel();
    return check_report("test_kernels");
}
