/* SPDX-License-Identifier: MIT */
/*
 * test_derivatives.c - CSPM, ICSPM, weighted least squares and BIM: the numbers of the ICSPM paper (Korzilius, Schilders & Anthonissen 2017, J. Appl. Math. Phys. 5,
 * 168) and its misprints, exactness, invariances, stencil rows, and the case where kappa is 0.
 */
#include "one_copy.h"
#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

#define KERNEL SPH_WENDLAND_C4_1D
#define EPSILON ((double)SPH_EPSILON)

enum { CSPM, ICSPM, WLS, METHODS };
static const char *const method_name[METHODS] = {"cspm", "icspm", "wls"};

/* ---- the operators, one instance of each for a method and a dimension ---- */

static sph_index sweep_1d(int method, const cloud *c, sph_index first, sph_index last, sph_real least, int fallback, sph_derivatives_out out)
{
    const sph_cloud targets = sph_cloud_range(cloud_view(c), first, last);
    const sph_scalars f = cloud_f(c);
    return method == CSPM    ? sph_derivatives_cspm(KERNEL, 1, targets, f, (sph_derivatives_options){.conditioning_min = least}, out)
           : method == ICSPM ? sph_derivatives_icspm(KERNEL, 1, targets, f, (sph_derivatives_options){.conditioning_min = least, .fallback_wls = fallback}, out)
                             : sph_derivatives_wls(KERNEL, 1, targets, f, (sph_derivatives_options){.conditioning_min = least}, out);
}
static sph_index sweep_2d(int method, const cloud *c, sph_index first, sph_index last, sph_real least, int fallback, sph_derivatives_out out)
{
    const sph_cloud targets = sph_cloud_range(cloud_view(c), first, last);
    const sph_scalars f = cloud_f(c);
    return method == CSPM    ? sph_derivatives_cspm(KERNEL, 2, targets, f, (sph_derivatives_options){.conditioning_min = least}, out)
           : method == ICSPM ? sph_derivatives_icspm(KERNEL, 2, targets, f, (sph_derivatives_options){.conditioning_min = least, .fallback_wls = fallback}, out)
                             : sph_derivatives_wls(KERNEL, 2, targets, f, (sph_derivatives_options){.conditioning_min = least}, out);
}
static sph_index sweep_3d(int method, const cloud *c, sph_index first, sph_index last, sph_real least, int fallback, sph_derivatives_out out)
{
    const sph_cloud targets = sph_cloud_range(cloud_view(c), first, last);
    const sph_scalars f = cloud_f(c);
    return method == CSPM    ? sph_derivatives_cspm(KERNEL, 3, targets, f, (sph_derivatives_options){.conditioning_min = least}, out)
           : method == ICSPM ? sph_derivatives_icspm(KERNEL, 3, targets, f, (sph_derivatives_options){.conditioning_min = least, .fallback_wls = fallback}, out)
                             : sph_derivatives_wls(KERNEL, 3, targets, f, (sph_derivatives_options){.conditioning_min = least}, out);
}
static sph_index sweep(int method, const cloud *c, sph_index first, sph_index last, sph_real least, int fallback, sph_derivatives_out out)
{
    return c->dim == 1   ? sweep_1d(method, c, first, last, least, fallback, out)
           : c->dim == 2 ? sweep_2d(method, c, first, last, least, fallback, out)
                         : sweep_3d(method, c, first, last, least, fallback, out);
}

static sph_index rows_1d(int method, const cloud *c, sph_jet d, sph_rows_out out)
{
    const sph_cloud all = cloud_view(c);
    return method == CSPM    ? sph_derivatives_rows_cspm(KERNEL, 1, all, d, out)
           : method == ICSPM ? sph_derivatives_rows_icspm(KERNEL, 1, all, d, out)
                             : sph_derivatives_rows_wls(KERNEL, 1, all, d, out);
}
static sph_index rows_2d(int method, const cloud *c, sph_jet d, sph_rows_out out)
{
    const sph_cloud all = cloud_view(c);
    return method == CSPM    ? sph_derivatives_rows_cspm(KERNEL, 2, all, d, out)
           : method == ICSPM ? sph_derivatives_rows_icspm(KERNEL, 2, all, d, out)
                             : sph_derivatives_rows_wls(KERNEL, 2, all, d, out);
}
static sph_index rows_3d(int method, const cloud *c, sph_jet d, sph_rows_out out)
{
    const sph_cloud all = cloud_view(c);
    return method == CSPM    ? sph_derivatives_rows_cspm(KERNEL, 3, all, d, out)
           : method == ICSPM ? sph_derivatives_rows_icspm(KERNEL, 3, all, d, out)
                             : sph_derivatives_rows_wls(KERNEL, 3, all, d, out);
}
static sph_index rows(int method, const cloud *c, sph_jet d, sph_rows_out out)
{
    return c->dim == 1 ? rows_1d(method, c, d, out) : c->dim == 2 ? rows_2d(method, c, d, out) : rows_3d(method, c, d, out);
}

/* ---- derivatives of a cloud: component a of particle i is d[a * n + i]. What was not written is NaN. ---- */

enum { LAPLACIAN = COMPONENTS, CONDITIONING, ARRAYS };

typedef struct derivatives {
    sph_index n, answer;
    sph_real *d;
    unsigned char *status;
} derivatives;

static sph_derivatives_out derivatives_out(derivatives *r)
{
    sph_derivatives_out out;
    sph_real **const array[ARRAYS] = {&out.gx, &out.gy, &out.gz, &out.hxx, &out.hxy, &out.hyy, &out.hxz, &out.hyz, &out.hzz, &out.laplacian, &out.conditioning};
    int a;
    for (a = 0; a < ARRAYS; a++) *array[a] = r->d + (size_t)a * (size_t)r->n;
    out.stride = 0;
    out.status = r->status;
    return out;
}
static derivatives derivatives_new(sph_index n)
{
    derivatives r;
    size_t i;
    r.n = n;
    r.answer = 0;
    r.d = (sph_real *)cloud_memory(ARRAYS * (size_t)n, sizeof *r.d);
    r.status = (unsigned char *)cloud_memory((size_t)n, 1);
    for (i = 0; i < ARRAYS * (size_t)n; i++) r.d[i] = SPH_R(NAN);
    return r;
}
static void derivatives_free(derivatives *r)
{
    free(r->d);
    free(r->status);
}
static derivatives derive_limited(int method, const cloud *c, double least, int fallback)
{
    derivatives r = derivatives_new(c->n);
    r.answer = sweep(method, c, 0, c->n, SPH_R(least), fallback, derivatives_out(&r));
    return r;
}
static derivatives derive(int method, const cloud *c) { return derive_limited(method, c, 0.0, 0); }
static double got(const derivatives *r, int component, sph_index i) { return (double)r->d[(size_t)component * (size_t)r->n + (size_t)i]; }

/* is the component one of this dimension? */
static int in_dim(int dim, int a) { return a < 3 ? a < dim : a < 3 + field_hessian_components(dim); }

/* |a| if it is larger than m; a NaN is larger than all */
static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }

/* Largest error of the gradient and of the Hessian over all particles; times |conditioning| (at most 1) if asked for. */
static void errors(const cloud *c, const derivatives *r, field_fn *f, int conditioned, double *gradient, double *hessian)
{
    sph_index i;
    *gradient = *hessian = 0.0;
    for (i = 0; i < c->n; i++) {
        const double scale = conditioned ? fmin(1.0, fabs(got(r, CONDITIONING, i))) : 1.0;
        double p[3], d[COMPONENTS];
        int a;
        cloud_position(c, i, p);
        f(p, d);
        for (a = 0; a < COMPONENTS; a++) {
            double *const e = a < 3 ? gradient : hessian;
            if (in_dim(c->dim, a)) *e = worse(*e, scale * (got(r, a, i) - d[a]));
        }
    }
}

/* ---- the ICSPM paper in 1D ---- */

/* An implementation of its own, in double and with plain loops over all particles, that can also be told to follow the misprints. */
enum { AS_MEANT, KAPPA_PLUS, W_FOR_W_PRIME, DWDY, BRACES_LOST, FULL_ENDS };

static double paper_w(double q)
{
    const double a = fabs(q), b = 2.0 - a;
    return a < 2.0 ? b * b * b * b * b * (2.0 * q * q + 2.5 * a + 1.0) : 0.0;
}
/* dW/dx_i at q = (x_i - x_j) / h, times h: negative for x_j < x_i */
static double paper_dw(double q)
{
    const double a = fabs(q), b = 2.0 - a;
    return a < 2.0 ? -7.0 * q * b * b * b * b * (2.0 * a + 1.0) : 0.0;
}

typedef struct paper {
    double cspm_gradient, cspm, icspm, kappa, bim;
} paper;

/* at particle i of n at x, with volumes V; the boundaries are particles 0 and n - 1 */
static paper paper_at(int print, int n, const double *x, const double *V, const double *f, double h, int i)
{
    const double sign = print == DWDY ? -1.0 : 1.0, sigma = 3.0 / (128.0 * h);
    double gt = 0.0, gs = 0.0, A = 0.0, B = 0.0, F1 = 0.0, F0 = 0.0, gamma = 0.0, slope = 0.0;
    paper p;
    int j;
    for (j = 0; j < n; j++) {
        const double q = (x[i] - x[j]) / h, e = x[j] - x[i], df = f[j] - f[i], w = paper_w(q), dw = sign * paper_dw(q) / h;
        gamma += sigma * w * V[j];
        if (j == i) continue;
        gt += e * dw * V[j];
        B += 0.5 * e * e * dw * V[j];
        F1 += df * dw * V[j];
        A += e * w * V[j];
        gs += 0.5 * e * e * w * V[j];
        F0 += df * w * V[j];
        if (w > 0.0 && e * e > 0.0) slope += df / e * sigma * dw * V[j];
    }
    p.cspm_gradient = (print == W_FOR_W_PRIME ? F0 : F1) / gt;
    p.cspm = (F0 - A * p.cspm_gradient) / gs;
    p.kappa = 1.0 + (print == KAPPA_PLUS ? 1.0 : -1.0) * A * B / (gt * gs);
    p.icspm = p.cspm / p.kappa;
    p.bim = 0.0;
    if (i > 0 && i < n - 1) {
        const double ends =
            (f[n - 1] - f[i]) / (x[n - 1] - x[i]) * sigma * paper_w((x[i] - x[n - 1]) / h) - (f[i] - f[0]) / (x[i] - x[0]) * sigma * paper_w((x[i] - x[0]) / h);
        p.bim = print == BRACES_LOST ? 2.0 / gamma * slope + ends : 2.0 / gamma * (slope + ends);
    }
    return p;
}

/* the cloud in double, as the library sees it */
typedef struct line {
    int n;
    double *x, *V, *f, h;
} line;
static line line_of(const cloud *c)
{
    line l;
    int i;
    l.n = (int)c->n;
    l.x = (double *)cloud_memory(3 * (size_t)c->n, sizeof *l.x);
    l.V = l.x + c->n;
    l.f = l.V + c->n;
    l.h = (double)c->h;
    for (i = 0; i < l.n; i++) {
        l.x[i] = (double)c->x[i];
        l.V[i] = (double)c->V[i];
        l.f[i] = (double)c->f[i];
    }
    return l;
}
static paper line_at(int print, const line *l, int i) { return paper_at(print, l->n, l->x, l->V, l->f, l->h, i); }

/* largest error of f'': ends included for CSPM and ICSPM, excluded for BIM */
static void paper_errors(int print, double h_over_dx, double *cspm, double *icspm, double *bim)
{
    enum { N = 41 };
    double x[N], V[N], f[N];
    const double dx = 1.0 / (N - 1);
    int i;
    for (i = 0; i < N; i++) {
        x[i] = (double)i / (N - 1);
        V[i] = (i == 0 || i == N - 1) && print != FULL_ENDS ? 0.5 * dx : dx;
        f[i] = field_paper(&x[i], 0);
    }
    *cspm = *icspm = *bim = 0.0;
    for (i = 0; i < N; i++) {
        const paper p = paper_at(print, N, x, V, f, h_over_dx * dx, i);
        double d[COMPONENTS];
        field_paper(&x[i], d);
        *cspm = worse(*cspm, p.cspm - d[3]);
        *icspm = worse(*icspm, p.icspm - d[3]);
        if (i > 0 && i < N - 1) *bim = worse(*bim, p.bim - d[3]);
    }
}

/* far enough from a printed number, whose last digit is the seventh */
#define CHECK_NOT(a, printed) CHECK(fabs((a) - (printed)) > 0.05 * fabs(printed))

static const double cspm_41 = 1.432149e+01, icspm_41 = 4.934995e-02, bim_41 = 1.535954e+00, bim_41_9 = 4.607038e-01;

static sph_index bim(const cloud *c, sph_index left, sph_index right, sph_real *out, unsigned char *status)
{
    return sph_second_derivative_bim(KERNEL, cloud_view(c), cloud_f(c), left, right,
                                     sph_scalar_out_array(out, status));
}
static double bim_error(const cloud *c, const sph_real *out)
{
    double e = 0.0;
    sph_index i;
    for (i = 1; i < c->n - 1; i++) {
        double p[3], d[COMPONENTS];
        cloud_position(c, i, p);
        field_paper(p, d);
        e = worse(e, (double)out[i] - d[3]);
    }
    return e;
}

static void test_paper(void)
{
    static const double kappa[] = {-0.207431, 0.514718, 0.961899, 0.999657}, tolerance = BY_PRECISION(1e-6, 2e-3);
    cloud c = cloud_lattice(1, 41, 2.0, 0.0, 1);
    sph_real *const out = (sph_real *)cloud_memory((size_t)c.n, sizeof *out);
    unsigned char *const status = (unsigned char *)cloud_memory((size_t)c.n, 1);
    derivatives r;
    double e, g;
    sph_index i;

    cloud_set(&c, field_paper);
    r = derive(CSPM, &c);
    CHECK(r.answer == 0);
    errors(&c, &r, field_paper, 0, &g, &e);
    CHECK_RELATIVE(e, cspm_41, tolerance);
    CHECK_NEAR("second derivative by CSPM", 0, got(&r, 3, 0), 1.622161, tolerance);
    derivatives_free(&r);

    r = derive(ICSPM, &c);
    CHECK(r.answer == 0);
    errors(&c, &r, field_paper, 0, &g, &e);
    CHECK_RELATIVE(e, icspm_41, BY_PRECISION(1e-6, 0.1));
    CHECK_NEAR("second derivative by ICSPM", 0, got(&r, 3, 0), -7.820254, BY_PRECISION(1e-6, 1e-2));
    for (i = 0; i < 4; i++) {
        CHECK_NEAR("kappa", i, got(&r, CONDITIONING, i), kappa[i], BY_PRECISION(5e-7, 1e-5));
        CHECK_NEAR("kappa", 40 - i, got(&r, CONDITIONING, 40 - i), kappa[i], BY_PRECISION(5e-7, 1e-5));
    }
    derivatives_free(&r);

    for (i = 0; i < c.n; i++) out[i] = SPH_R(77);
    CHECK(bim(&c, 0, 40, out, status) == 2);
    CHECK_RELATIVE(bim_error(&c, out), bim_41, tolerance);
    CHECK(status[0] == SPH_NOT_AVAILABLE && status[40] == SPH_NOT_AVAILABLE);
    CHECK_NEAR("BIM at an end", 0, out[0], 0.0, 0.0);
    CHECK_NEAR("BIM at an end", 40, out[40], 0.0, 0.0);
    for (i = 1; i < 40; i++) CHECK_SAME("status of BIM", i, status[i], SPH_OK);
    CHECK(bim(&c, 0, 40, out, 0) == 2); /* nobody has to ask for the status */
    cloud_free(&c);

    c = cloud_lattice(1, 41, 9.0, 0.0, 1);
    cloud_set(&c, field_paper);
    CHECK(bim(&c, 0, 40, out, status) == 2);
    CHECK_RELATIVE(bim_error(&c, out), bim_41_9, tolerance);
    /* ends of its own: the particles outside of them are not available, those inside see the integrals of the shorter interval */
    CHECK(bim(&c, 4, 38, out, status) == 8);
    CHECK(status[4] == SPH_NOT_AVAILABLE && status[5] == SPH_OK && status[37] == SPH_OK && status[38] == SPH_NOT_AVAILABLE);
    cloud_free(&c);
    free(out);
    free(status);
}

static void test_misprints(void)
{
    double c, i, b;
    paper_errors(AS_MEANT, 2.0, &c, &i, &b);
    CHECK_RELATIVE(c, cspm_41, 1e-6);
    CHECK_RELATIVE(i, icspm_41, 1e-6);
    CHECK_RELATIVE(b, bim_41, 1e-6);
    paper_errors(AS_MEANT, 9.0, &c, &i, &b);
    CHECK_RELATIVE(b, bim_41_9, 1e-6);

    paper_errors(KAPPA_PLUS, 2.0, &c, &i, &b); /* (4.12), (4.14), (5.17) */
    CHECK_RELATIVE(i, 1.298e+01, 5e-4);
    CHECK_NOT(i, icspm_41);
    paper_errors(W_FOR_W_PRIME, 2.0, &c, &i, &b); /* <f'> in the list under (5.17) */
    CHECK_RELATIVE(c, 1.172e+02, 5e-4);
    CHECK_NOT(c, cspm_41);
    paper_errors(DWDY, 2.0, &c, &i, &b); /* section II */
    CHECK_RELATIVE(b, 6.489e+01, 5e-4);
    CHECK_NOT(b, bim_41);
    paper_errors(BRACES_LOST, 9.0, &c, &i, &b); /* (4.9), (5.16) */
    CHECK_RELATIVE(b, 1.502e+01, 5e-4);
    CHECK_NOT(b, bim_41_9);
    paper_errors(FULL_ENDS, 2.0, &c, &i, &b);
    CHECK_RELATIVE(b, 1.577e+01, 5e-4);
    CHECK_NOT(b, bim_41);
}

/* kappa f''_ICSPM = f''_CSPM, and all three from independent sums; one-sided neighbours make kappa negative */
static void check_identity(const cloud *c)
{
    derivatives s = derive(CSPM, c), t = derive(ICSPM, c);
    const line l = line_of(c);
    const double loose = BY_PRECISION(1e-10, 1e-3);
    double scale = 0.0;
    int i;
    for (i = 0; i < l.n; i++) scale = worse(scale, line_at(AS_MEANT, &l, i).cspm);
    for (i = 0; i < l.n; i++) {
        const paper p = line_at(AS_MEANT, &l, i);
        const double kappa = got(&t, CONDITIONING, i), small = fmin(1.0, fabs(p.kappa));
        CHECK_NEAR("kappa", i, kappa, p.kappa, BY_PRECISION(1e-13, 1e-5));
        CHECK_NEAR("second derivative by CSPM beside kappa times ICSPM's", i, got(&s, 3, i),
                   kappa * got(&t, 3, i), loose * scale);
        CHECK_NEAR("second derivative by CSPM", i, got(&s, 3, i), p.cspm, loose * scale);
        CHECK_NEAR("first derivative by CSPM", i, got(&s, 0, i), p.cspm_gradient,
                   BY_PRECISION(1e-11, 1e-4) * scale);
        CHECK_NEAR("second derivative by ICSPM", i, got(&t, 3, i), p.icspm, loose * scale / (small * small));
    }
    CHECK(got(&t, CONDITIONING, 0) < 0.0 && got(&t, CONDITIONING, c->n - 1) < 0.0);
    derivatives_free(&s);
    derivatives_free(&t);
    free(l.x);
}
static void test_identity(void)
{
    cloud c = cloud_lattice(1, 41, 2.0, 0.25, 3);
    cloud_set(&c, field_smooth);
    check_identity(&c);
    cloud_free(&c);
    c = cloud_random_1d(41, 2.0, 5);
    cloud_set(&c, field_paper);
    check_identity(&c);
    cloud_free(&c);
}

/* ---- exactness ---- */

static void check_exact(const cloud *c0)
{
    cloud c = *c0;
    const double unit = EPSILON / c.dx; /* round-off of a gradient; of a Hessian it is one dx more */
    int method;
    for (method = 0; method < METHODS; method++) {
        derivatives r;
        double g, h;
        sph_index i;
        cloud_set(&c, field_constant);
        r = derive(method, &c);
        CHECK(r.answer == 0);
        errors(&c, &r, field_constant, 0, &g, &h);
        CHECK(!(g > 0.0) && !(h > 0.0)); /* differences of equal numbers */
        derivatives_free(&r);

        cloud_set(&c, field_linear);
        r = derive(method, &c);
        errors(&c, &r, field_linear, method != CSPM, &g, &h);
        CHECK_WORST(check_words("gradient of a linear field by %s in %dD", method_name[method], c.dim), g,
                    200.0 * unit);
        derivatives_free(&r);

        cloud_set(&c, field_quadratic);
        r = derive(method, &c);
        CHECK(r.answer == 0);
        errors(&c, &r, field_quadratic, method != CSPM, &g, &h);
        if (method == CSPM) {
            CHECK(g > 1e-3);
            CHECK(h > 0.1);
        } else {
            CHECK_WORST(check_words("gradient of a quadratic field by %s in %dD", method_name[method], c.dim),
                        g, 300.0 * unit);
            CHECK_WORST(check_words("Hessian of a quadratic field by %s in %dD", method_name[method], c.dim),
                        h, 600.0 * unit / c.dx);
        }
        for (i = 0; i < c.n; i++) { /* the Laplacian is the trace */
            const double trace = got(&r, 3, i) + (c.dim > 1 ? got(&r, 5, i) : 0.0) + (c.dim > 2 ? got(&r, 8, i) : 0.0);
            CHECK_NEAR(check_words("Laplacian beside the trace, by %s in %dD", method_name[method], c.dim), i,
                       got(&r, LAPLACIAN, i), trace, 8.0 * EPSILON * (fabs(got(&r, 3, i)) + fabs(trace) + 10.0));
        }
        for (i = 0; method == WLS && i < c.n; i++)
            CHECK_AT(check_words("conditioning of WLS in %dD", c.dim), i,
                     got(&r, CONDITIONING, i) > 0.0 && got(&r, CONDITIONING, i) <= 1.0 + 1e-3);
        for (i = 0; c.dim < 3 && i < c.n; i++) /* components of higher dimensions are not written */
            CHECK_AT(check_words("components beyond %dD", c.dim), i,
                     isnan(got(&r, 2, i)) && isnan(got(&r, 8, i)) && (c.dim > 1 || isnan(got(&r, 4, i))));
        derivatives_free(&r);
    }
}

static void test_exactness(void)
{
    static const int side[] = {0, 41, 13, 7};
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.25, (uint64_t)dim);
        check_exact(&c);
        cloud_random_volumes(&c, 17);
        check_exact(&c);
        cloud_free(&c);
    }
}

/* ---- two dimensions: errors, orders and signs of kappa on the unit square ---- */

static void test_square(void)
{
    /* gradient and Hessian of CSPM, ICSPM, WLS with 11, 21, 41 particles per side and h = 2 dx */
    static const double known[3][METHODS][2] = {{{6.512e-1, 9.384}, {1.238e-1, 2.530}, {9.380e-2, 1.683}},
                                                {{3.493e-1, 9.719}, {3.140e-2, 1.275}, {2.436e-2, 0.8465}},
                                                {{1.799e-1, 9.864}, {7.876e-3, 0.6390}, {6.108e-3, 0.4239}}};
    static const double order[METHODS][2] = {{0.95, 0.0}, {2.0, 1.0}, {2.0, 1.0}};
    int size, method;
    for (size = 0; size < 3; size++) {
        const int side = 10 * (1 << size) + 1;
        cloud c = cloud_lattice(2, side, 2.0, 0.0, 1);
        cloud_set(&c, field_smooth);
        for (method = 0; method < METHODS; method++) {
            derivatives r = derive(method, &c);
            double g, h;
            CHECK(r.answer == 0);
            errors(&c, &r, field_smooth, 0, &g, &h);
            CHECK_RELATIVE(g, known[size][method][0], BY_PRECISION(6e-4, 2e-2));
            CHECK_RELATIVE(h, known[size][method][1], BY_PRECISION(6e-4, 4e-2));
            if (method == ICSPM) {
                const sph_index s = (sph_index)side;
                CHECK_AT("kappa in a corner", 0, got(&r, CONDITIONING, 0) > 0.0);
                CHECK_AT("kappa beside a corner", 1, got(&r, CONDITIONING, 1) < 0.0);
                CHECK_AT("kappa beside a corner", s, got(&r, CONDITIONING, s) < 0.0);
                CHECK_AT("kappa on a wall", s / 2, got(&r, CONDITIONING, s / 2) < 0.0);
                CHECK_AT("kappa at (1, 1)", s + 1, got(&r, CONDITIONING, s + 1) > 0.0);
                CHECK_AT("kappa in the first layer", s + s / 2, got(&r, CONDITIONING, s + s / 2) > 0.0);
                CHECK_AT("kappa in the second layer", 2 * s + s / 2,
                         got(&r, CONDITIONING, 2 * s + s / 2) > 0.0);
                CHECK_NEAR("kappa in the centre", s * (s / 2) + s / 2,
                           got(&r, CONDITIONING, s * (s / 2) + s / 2), 1.0, 1e-5);
            }
            derivatives_free(&r);
        }
        cloud_free(&c);
    }
    for (method = 0; method < METHODS; method++) { /* of the table, which the errors above agree with */
        CHECK_CLOSE(log2(known[1][method][0] / known[2][method][0]), order[method][0], 0.06);
        CHECK_CLOSE(log2(known[1][method][1] / known[2][method][1]), order[method][1], 0.06);
    }
}

/* ---- invariances ---- */

/* Derivatives of the changed cloud must be those of the first one: component a times factor g (gradient) or g^2 (Hessian), axis a' = permutation[a] with its sign. */
static void compare(const cloud *c, const derivatives *r, const derivatives *t, double g, const int *permutation, const int *sign, double tolerance,
                    int same_pivots)
{
    static const int pair[3][3] = {{3, 4, 6}, {4, 5, 7}, {6, 7, 8}}; /* component of d_a d_b */
    double largest[2] = {0.0, 0.0}, off[2] = {0.0, 0.0}, conditioning = 0.0;
    sph_index i;
    int a, b;
    for (i = 0; i < c->n; i++) {
        const double small = fmin(1.0, fabs(got(r, CONDITIONING, i)));
        for (a = 0; a < c->dim; a++) {
            const double want = sign[a] * g * got(r, permutation[a], i);
            largest[0] = worse(largest[0], want);
            off[0] = worse(off[0], small * (got(t, a, i) - want));
            for (b = 0; b < c->dim; b++) {
                const double want2 = sign[a] * sign[b] * g * g * got(r, pair[permutation[a]][permutation[b]], i);
                largest[1] = worse(largest[1], want2);
                off[1] = worse(off[1], small * (got(t, pair[a][b], i) - want2));
            }
        }
        conditioning = worse(conditioning, got(t, CONDITIONING, i) - got(r, CONDITIONING, i));
    }
    CHECK_WORST(check_words("gradient of a changed cloud in %dD", c->dim), off[0] / largest[0], tolerance);
    CHECK_WORST(check_words("Hessian of a changed cloud in %dD", c->dim), off[1] / largest[1], tolerance);
    if (same_pivots)
        CHECK_WORST(check_words("conditioning of a changed cloud in %dD", c->dim), conditioning, tolerance);
}

static void check_invariance(int method, const cloud *c)
{
    static const int same[] = {0, 1, 2}, plus[] = {1, 1, 1};
    static const struct {
        int axis[3], sign[3];
    } turn[] = {{{1, 0, 2}, {-1, 1, 1}}, {{1, 2, 0}, {1, 1, 1}}, {{2, 1, 0}, {1, 1, -1}}, {{0, 2, 1}, {1, -1, 1}}, {{0, 1, 2}, {-1, 1, 1}}};
    static const double length[] = {1048576.0, 1.0 / 1048576.0, 1e-6, 1e6, 3.0};
    const double sharp = BY_PRECISION(1e-12, 1e-4), loose = BY_PRECISION(1e-10, 1e-2);
    const size_t n = (size_t)c->n;
    derivatives r = derive(method, c);
    cloud t = cloud_new(c->dim, c->n);
    size_t s, i;
    int a;
    CHECK(r.answer == 0);
    free(t.start);
    t.start = c->start;
    t.index = c->index;
    memcpy(t.f, c->f, n * sizeof *t.f);
    for (s = 0; s < sizeof length / sizeof *length; s++) {
        const double L = length[s], volume = pow(L, c->dim);
        derivatives q;
        for (i = 0; i < n; i++) {
            t.x[i] = SPH_R(L * (double)c->x[i]);
            t.y[i] = SPH_R(L * (double)c->y[i]);
            t.z[i] = SPH_R(L * (double)c->z[i]);
            t.V[i] = SPH_R(volume * (double)c->V[i]);
        }
        t.h = SPH_R(L * (double)c->h);
        q = derive(method, &t);
        compare(c, &r, &q, 1.0 / L, same, plus, s < 2 ? sharp : loose, 1); /* a power of two does not even round */
        derivatives_free(&q);
    }
    t.h = c->h;
    for (s = 0; s < 2; s++) { /* volumes times a constant; and moved */
        const double factor = s == 0 ? 3.7 : 1.0, move = s == 0 ? 0.0 : 3.0;
        derivatives q;
        for (i = 0; i < n; i++) {
            t.x[i] = SPH_R((double)c->x[i] + move);
            t.y[i] = SPH_R((double)c->y[i] - 1.7 * move);
            t.z[i] = SPH_R((double)c->z[i] + 0.3 * move);
            t.V[i] = SPH_R(factor * (double)c->V[i]);
        }
        q = derive(method, &t);
        compare(c, &r, &q, 1.0, same, plus, s == 0 ? loose : BY_PRECISION(1e-10, 3e-2), 1);
        derivatives_free(&q);
    }
    memcpy(t.V, c->V, n * sizeof *t.V);
    for (s = 0; s < sizeof turn / sizeof *turn; s++) { /* new coordinate a = sign[a] * old coordinate axis[a] */
        const sph_real *const from[3] = {c->x, c->y, c->z};
        sph_real *const to[3] = {t.x, t.y, t.z};
        derivatives q;
        for (a = 0; a < c->dim && turn[s].axis[a] < c->dim; a++) {}
        if (a < c->dim) continue; /* this one needs an axis that there is not */
        for (a = 0; a < 3; a++)
            for (i = 0; i < n; i++) to[a][i] = SPH_R(turn[s].sign[a]) * from[turn[s].axis[a]][i];
        q = derive(method, &t);
        compare(c, &r, &q, 1.0, turn[s].axis, turn[s].sign, loose, method != CSPM); /* CSPM: the order of the pivots is that of the axes */
        derivatives_free(&q);
    }
    t.index = 0;
    t.start = 0;
    cloud_free(&t);
    derivatives_free(&r);
}

static void test_invariance(void)
{
    static const int side[] = {0, 21, 9, 6};
    int dim, method;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.2, (uint64_t)(20 + dim));
        cloud_set(&c, field_smooth);
        for (method = 0; method < METHODS; method++) check_invariance(method, &c);
        cloud_free(&c);
    }
}

/* ---- the pair tier does what the list tier does ---- */

static int solve_by_hand(int method, int dim, const cloud *c, sph_index i, sph_jet *jet, sph_real *conditioning)
{
    sph_moments m = sph_moments_zero();
    sph_index p;
    for (p = c->start[i]; p < c->start[i + 1]; p++) {
        const sph_index j = c->index[p];
        sph_vec e;
        sph_test_weights t;
        e.x = (c->x[j] - c->x[i]) / c->h;
        e.y = (c->y[j] - c->y[i]) / c->h;
        e.z = (c->z[j] - c->z[i]) / c->h;
        t = method == WLS ? sph_test_weights_wls(KERNEL, dim, sph_length(dim, e), c->V[j]) : sph_test_weights_cspm(KERNEL, dim, sph_length(dim, e), c->V[j]);
        sph_moments_add(dim, &m, e, t);
        sph_moments_add_value(dim, &m, e, t, c->f[j] - c->f[i]);
    }
    return method == CSPM ? sph_solve_cspm(dim, &m, c->h, jet, conditioning) : sph_solve_block(dim, &m, c->h, jet, conditioning);
}

static sph_real *jet_at(sph_jet *j, int a)
{
    sph_real *const component[COMPONENTS] = {&j->gradient.x, &j->gradient.y, &j->gradient.z, &j->hessian.xx, &j->hessian.xy,
                                             &j->hessian.yy, &j->hessian.xz, &j->hessian.yz, &j->hessian.zz};
    return component[a];
}

static void test_pair_tier(void)
{
    static const int side[] = {0, 21, 9, 6};
    int dim, method, a;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.25, (uint64_t)(30 + dim));
        cloud_set(&c, field_smooth);
        for (method = 0; method < METHODS; method++) {
            derivatives r = derive(method, &c), s = derivatives_new(c.n);
            const sph_derivatives_out out = derivatives_out(&s);
            double off[2] = {0.0, 0.0}, conditioning = 0.0;
            sph_index i;
            for (i = 0; i < c.n; i++) {
                const double small = method == CSPM ? 1.0 : fmin(1.0, fabs(got(&r, CONDITIONING, i)));
                sph_jet j;
                sph_real k;
                CHECK_SAME("answer of the pair tier", i, solve_by_hand(method, dim, &c, i, &j, &k), SPH_OK);
                for (a = 0; a < COMPONENTS; a++)
                    if (in_dim(dim, a)) off[a > 2] = worse(off[a > 2], small * ((double)*jet_at(&j, a) - got(&r, a, i)));
                conditioning = worse(conditioning, (double)k - got(&r, CONDITIONING, i));
            }
            CHECK_WORST(check_words("gradient of the pair tier by %s in %dD", method_name[method], dim),
                        off[0], BY_PRECISION(1e-11, 2e-3));
            CHECK_WORST(check_words("Hessian of the pair tier by %s in %dD", method_name[method], dim),
                        off[1], BY_PRECISION(1e-9, 0.05));
            CHECK_WORST(check_words("conditioning of the pair tier by %s in %dD", method_name[method], dim),
                        conditioning, BY_PRECISION(1e-12, 1e-4));

            /* in parts, and out of order: the same bits (NaN where nothing is written has the same bits, too) */
            CHECK(sweep(method, &c, 5, c.n - 2, SPH_R(0), 0, out) == 0);
            CHECK(isnan(got(&s, 0, 4)) && isnan(got(&s, 0, c.n - 2)) && isnan(got(&s, LAPLACIAN, 4)) && !isnan(got(&s, LAPLACIAN, 5)));
            CHECK(sweep(method, &c, 3, 3, SPH_R(0), 0, out) == 0);
            CHECK(isnan(got(&s, 0, 3)));
            CHECK(sweep(method, &c, c.n - 2, c.n, SPH_R(0), 0, out) == 0);
            CHECK(sweep(method, &c, 0, 5, SPH_R(0), 0, out) == 0);
            CHECK(memcmp(r.d, s.d, ARRAYS * (size_t)c.n * sizeof *r.d) == 0);
            CHECK(memcmp(r.status, s.status, (size_t)c.n) == 0);

            derivatives_free(&r);
            derivatives_free(&s);
        }
        cloud_free(&c);
    }
}

/* ---- rows ---- */

typedef struct row_arrays {
    sph_real *row, *diagonal, *factor, *conditioning;
    unsigned char *status;
    sph_rows_out out;
} row_arrays;

static row_arrays row_arrays_new(const cloud *c)
{
    row_arrays r;
    r.row = (sph_real *)cloud_memory((size_t)c->pairs, sizeof *r.row);
    r.diagonal = (sph_real *)cloud_memory((size_t)c->n, sizeof *r.row);
    r.factor = (sph_real *)cloud_memory((size_t)c->n, sizeof *r.row);
    r.conditioning = (sph_real *)cloud_memory((size_t)c->n, sizeof *r.row);
    r.status = (unsigned char *)cloud_memory((size_t)c->n, 1);
    r.out.row = r.row;
    r.out.diagonal = r.diagonal;
    r.out.factor = r.factor;
    r.out.conditioning = r.conditioning;
    r.out.stride = 1;
    r.out.status = r.status;
    return r;
}
static void row_arrays_free(row_arrays *r)
{
    free(r->row);
    free(r->diagonal);
    free(r->factor);
    free(r->conditioning);
    free(r->status);
}

/* sum_p row[p] (f_j - f_i), and the sum of the magnitudes */
static double apply(const cloud *c, const sph_real *row, sph_index i, double *magnitude)
{
    double s = 0.0;
    sph_index p;
    *magnitude = 0.0;
    for (p = c->start[i]; p < c->start[i + 1]; p++) {
        const double term = (double)row[p] * ((double)c->f[c->index[p]] - (double)c->f[i]);
        s += term;
        *magnitude += fabs(term);
    }
    return s;
}

static void check_rows(int method, const cloud *c, const derivatives *r, sph_jet d, row_arrays *w)
{
    double off = 0.0, diagonal = 0.0, conditioning = 0.0;
    sph_index i, p;
    CHECK(rows(method, c, d, w->out) == 0);
    for (i = 0; i < c->n; i++) {
        const double small = method == CSPM ? 1.0 : fmin(1.0, fabs(got(r, CONDITIONING, i)));
        double magnitude, value = 0.0, sum = 0.0, sizes = 0.0, scale;
        const double applied = apply(c, w->row, i, &magnitude);
        int a;
        for (a = 0; a < COMPONENTS; a++)
            if (in_dim(c->dim, a)) {
                value += (double)*jet_at(&d, a) * got(r, a, i);
                sizes += fabs((double)*jet_at(&d, a) * got(r, a, i));
            }
        scale = (magnitude + fabs((double)w->factor[i]) * sizes) / small;
        off = worse(off, (applied - (double)w->factor[i] * value) / scale);
        magnitude = 0.0;
        for (p = c->start[i]; p < c->start[i + 1]; p++) {
            sum += (double)w->row[p];
            magnitude += fabs((double)w->row[p]);
        }
        diagonal = worse(diagonal, ((double)w->diagonal[i] + sum) / magnitude);
        conditioning = worse(conditioning, (double)w->conditioning[i] - got(r, CONDITIONING, i));
        if (method != ICSPM)
            CHECK_NEAR(check_words("factor of %s", method_name[method]), i, w->factor[i], 1.0, 0.0);
        CHECK_SAME(check_words("status of a row of %s", method_name[method]), i, w->status[i], SPH_OK);
    }
    CHECK_WORST(check_words("rows of %s in %dD", method_name[method], c->dim), off, 200.0 * EPSILON);
    CHECK_WORST(check_words("diagonals of %s in %dD", method_name[method], c->dim), diagonal,
                100.0 * EPSILON);
    CHECK_WORST(check_words("conditioning of rows of %s in %dD", method_name[method], c->dim), conditioning,
                BY_PRECISION(1e-12, 1e-4));
}

static void test_rows(void)
{
    static const int side[] = {0, 21, 9, 6};
    int dim, method, a, b;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.25, (uint64_t)(40 + dim));
        row_arrays w = row_arrays_new(&c);
        pcg32 g;
        pcg32_seed(&g, 5, 5);
        cloud_set(&c, field_smooth);
        for (method = 0; method < METHODS; method++) {
            derivatives r = derive(method, &c);
            check_rows(method, &c, &r, sph_jet_laplacian(dim), &w);
            for (a = 0; a <= COMPONENTS; a++) { /* each derivative alone, and all at random */
                sph_jet d;
                for (b = 0; b < COMPONENTS; b++) *jet_at(&d, b) = SPH_R(a == COMPONENTS ? cloud_symmetric(&g) : a == b ? 1.0 : 0.0);
                if (a == COMPONENTS || in_dim(dim, a)) check_rows(method, &c, &r, d, &w);
            }
            {
                sph_rows_out only = {0};
                only.diagonal = only.factor = only.conditioning = 0;
                only.status = 0;
                only.row = w.row;
                CHECK(rows(method, &c, sph_jet_laplacian(dim), only) == 0); /* all but the row may be missing */
            }
            derivatives_free(&r);
        }
        if (dim == 1) { /* as published: the rows of CSPM, and kappa on the right-hand side */
            row_arrays v = row_arrays_new(&c);
            const line l = line_of(&c);
            sph_index i, p;
            CHECK(rows(CSPM, &c, sph_jet_laplacian(1), v.out) == 0);
            CHECK(rows(ICSPM, &c, sph_jet_laplacian(1), w.out) == 0);
            for (i = 0; i < c.n; i++) {
                double largest = 0.0, off = 0.0;
                for (p = c.start[i]; p < c.start[i + 1]; p++) {
                    largest = worse(largest, (double)v.row[p]);
                    off = worse(off, (double)v.row[p] - (double)w.row[p]);
                }
                CHECK_NEAR("row of ICSPM beside that of CSPM, largest difference", i, off / largest, 0.0,
                           BY_PRECISION(1e-12, 1e-4));
                CHECK_NEAR("factor of a row of ICSPM", i, w.factor[i], line_at(AS_MEANT, &l, (int)i).kappa,
                           BY_PRECISION(1e-12, 1e-5));
            }
            free(l.x);
            row_arrays_free(&v);
        }
        row_arrays_free(&w);
        cloud_free(&c);
    }
}

/* the rows of the other operators */
static void check_applied(const cloud *c, const sph_real *row, const sph_real *value)
{
    double off = 0.0, largest = 0.0;
    sph_index i;
    for (i = 0; i < c->n; i++) {
        double magnitude;
        const double applied = apply(c, row, i, &magnitude);
        off = worse(off, (applied - (double)value[i]) / (magnitude > 0.0 ? magnitude : 1.0));
        largest = worse(largest, applied);
    }
    CHECK_WORST(check_words("rows beside the operator in %dD", c->dim), off, 100.0 * EPSILON);
    CHECK(largest > 0.1);
}

#define OTHER_ROWS(dim) \
    static void other_rows_##dim(const cloud *c, sph_gradient_rows_out w, sph_derivatives_out g) \
    { \
        const sph_cloud all = cloud_view(c); \
        const sph_scalars f = cloud_f(c); \
        sph_real *const row = w.conditioning, *const out = g.conditioning; \
        CHECK(sph_laplacian_brookshaw(KERNEL, dim, all, f, sph_scalar_out_array(out, 0)) == 0); \
        CHECK(sph_laplacian_rows_brookshaw(KERNEL, dim, all, (sph_rows_out){.row = row}) == 0); \
        check_applied(c, row, out); \
        CHECK(sph_gradient_cspm(KERNEL, dim, all, f, g) == 0); \
        CHECK(sph_gradient_rows_cspm(KERNEL, dim, all, w) == 0); \
        CHECK(memcmp(out, row, (size_t)c->n * sizeof *out) == 0); /* conditioning */ \
        check_applied(c, w.x, g.gx); \
        if (dim > 1) check_applied(c, w.y, g.gy); \
        if (dim > 2) check_applied(c, w.z, g.gz); \
    }
OTHER_ROWS(1)
OTHER_ROWS(2)
OTHER_ROWS(3)

static void test_other_rows(void)
{
    static const int side[] = {0, 21, 9, 6};
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, side[dim], 2.0, 0.25, (uint64_t)(50 + dim));
        const size_t pairs = (size_t)c.pairs, n = (size_t)c.n;
        sph_real *const row = (sph_real *)cloud_memory(4 * pairs + 4 * n, sizeof *row), *const out = row + 4 * pairs;
        unsigned char *const status = (unsigned char *)cloud_memory(n, 1);
        const sph_gradient_rows_out w = {.x = row + pairs,
                                        .y = dim > 1 ? row + 2 * pairs : 0,
                                        .z = dim > 2 ? row + 3 * pairs : 0,
                                        .conditioning = row};
        const sph_derivatives_out g = {.gx = out + n,
                                      .gy = dim > 1 ? out + 2 * n : 0,
                                      .gz = dim > 2 ? out + 3 * n : 0,
                                      .conditioning = out};
        cloud_set(&c, field_smooth);
        if (dim == 1) {
            other_rows_1(&c, w, g);
            CHECK(bim(&c, 0, c.n - 1, out, 0) == 2);
            CHECK(sph_second_derivative_rows_bim(KERNEL, cloud_view(&c), 0, c.n - 1, (sph_rows_out){.row = row, .status = status}) == 2);
            CHECK(status[0] == SPH_NOT_AVAILABLE && status[1] == SPH_OK && status[c.n - 1] == SPH_NOT_AVAILABLE);
            check_applied(&c, row, out);
        } else if (dim == 2) other_rows_2(&c, w, g);
        else other_rows_3(&c, w, g);
        free(row);
        free(status);
        cloud_free(&c);
    }
}

/* ---- kappa = 0 at particle 1 (and its mirror image) ---- */

static double kappa_of(const cloud *c, int i)
{
    const line l = line_of(c);
    const double kappa = line_at(AS_MEANT, &l, i).kappa;
    free(l.x);
    return kappa;
}

static void test_singular_kappa(void)
{
    double low = 3.6, high = 3.7, g, h, applied, magnitude;
    cloud c = cloud_lattice(1, 81, 3.7, 0.0, 1);
    derivatives r;
    row_arrays w = row_arrays_new(&c);
    sph_index i, fewer = 0;
    int step;
    cloud_set(&c, field_paper);
    for (step = 0; step < 60; step++) {
        const double middle = 0.5 * (low + high);
        c.h = SPH_R(middle * c.dx);
        if (kappa_of(&c, 1) < 0.0) high = middle;
        else low = middle;
    }
    CHECK_CLOSE(low, 3.640709, BY_PRECISION(1e-6, 1e-4));
    CHECK_CLOSE(kappa_of(&c, 1), 0.0, 10.0 * EPSILON);
    for (i = 0; i < c.n; i++) fewer += fabs(kappa_of(&c, (int)i)) < 0.2;
    CHECK(fewer >= 2 && fewer < 8);

    r = derive(ICSPM, &c);
    errors(&c, &r, field_paper, 0, &g, &h);
    CHECK(r.status[1] == SPH_SINGULAR || fabs(got(&r, 3, 1)) > BY_PRECISION(1e8, 1e3));
    CHECK(r.answer == (r.status[1] == SPH_SINGULAR) + (r.status[79] == SPH_SINGULAR));
    if (r.status[1] == SPH_SINGULAR) {
        CHECK_NEAR("first derivative where kappa is 0", 1, got(&r, 0, 1), 0.0, 0.0);
        CHECK_NEAR("second derivative where kappa is 0", 1, got(&r, 3, 1), 0.0, 0.0);
        CHECK_NEAR("Laplacian where kappa is 0", 1, got(&r, LAPLACIAN, 1), 0.0, 0.0);
    }
    CHECK(h > 5.0);
    derivatives_free(&r);

    /* nothing divides by kappa in the rows: both sides of the equation are right */
    CHECK(rows(ICSPM, &c, sph_jet_laplacian(1), w.out) == 0);
    CHECK(fabs((double)w.factor[1]) < 100.0 * EPSILON);
    applied = apply(&c, w.row, 1, &magnitude);
    CHECK_CLOSE(applied, 0.0, 0.05 * magnitude);
    CHECK(magnitude > 1.0 && magnitude < 1e3);

    r = derive_limited(ICSPM, &c, 0.2, 0);
    CHECK(r.answer == fewer);
    for (i = 0; i < c.n; i++)
        CHECK_SAME("whether kappa is too small", i, r.status[i] != SPH_OK, fabs(kappa_of(&c, (int)i)) < 0.2);
    CHECK(r.status[1] == SPH_ILL_CONDITIONED || r.status[1] == SPH_SINGULAR);
    for (i = 2; i < c.n - 2; i++)
        CHECK_AT("status inside", i, r.status[i] == SPH_OK || r.status[i] == SPH_ILL_CONDITIONED);
    derivatives_free(&r);

    /* a limit that only well-conditioned particles cross keeps their values: 0.9 flags more, changes nothing */
    {
        derivatives s = derive_limited(ICSPM, &c, 0.9, 0), t = derive(ICSPM, &c);
        CHECK(s.answer > fewer);
        CHECK(memcmp(s.d, t.d, ARRAYS * (size_t)c.n * sizeof *s.d) == 0);
        derivatives_free(&s);
        derivatives_free(&t);
        s = derive_limited(WLS, &c, 1.5, 0);
        CHECK(s.answer == c.n && s.status[40] == SPH_ILL_CONDITIONED);
        derivatives_free(&s);
        s = derive_limited(CSPM, &c, 1.5, 0);
        CHECK(s.answer == c.n && s.status[40] == SPH_ILL_CONDITIONED);
        derivatives_free(&s);
    }

    r = derive_limited(ICSPM, &c, 0.2, 1);
    {
        derivatives s = derive(WLS, &c), t = derive(ICSPM, &c);
        CHECK(r.answer == fewer);
        CHECK(r.status[1] == SPH_FELL_BACK && r.status[79] == SPH_FELL_BACK && r.status[40] == SPH_OK);
        errors(&c, &r, field_paper, 0, &g, &h);
        CHECK(h < 1.0);
        for (i = 0; i < c.n; i++) { /* the one or the other */
            const derivatives *const from = r.status[i] == SPH_FELL_BACK ? &s : &t;
            CHECK_NEAR("second derivative with fallback", i, got(&r, 3, i), got(from, 3, i), 0.0);
            CHECK_NEAR("first derivative with fallback", i, got(&r, 0, i), got(from, 0, i), 0.0);
            CHECK_NEAR("Laplacian with fallback", i, got(&r, LAPLACIAN, i), got(from, LAPLACIAN, i), 0.0);
        }
        derivatives_free(&s);
        derivatives_free(&t);
    }
    derivatives_free(&r);
    row_arrays_free(&w);
    cloud_free(&c);
}

static void test_laplacian(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        const sph_jet d = sph_jet_laplacian(dim);
        CHECK((double)d.hessian.xx == 1.0 && (double)d.hessian.yy == (dim > 1) && (double)d.hessian.zz == (dim > 2));
        CHECK((double)d.hessian.xy == 0.0 && (double)d.hessian.xz == 0.0 && (double)d.hessian.yz == 0.0);
        CHECK((double)d.gradient.x == 0.0 && (double)d.gradient.y == 0.0 && (double)d.gradient.z == 0.0);
    }
}

/* the systems are scaled to unit diagonals: pivots, and so the conditioning that is reported, are relative to that */
static void test_scales(void)
{
    int dim, i;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, dim == 1 ? 21 : 7, 1.3, 0.25, 5);
        const sph_index middle = c.n / 2;
        sph_moments m = sph_moments_zero();
        sphi_blocks b;
        sph_index p;
        for (p = c.start[middle]; p < c.start[middle + 1]; p++) {
            const sph_index j = c.index[p];
            sph_vec e;
            e.x = (c.x[j] - c.x[middle]) / c.h;
            e.y = (c.y[j] - c.y[middle]) / c.h;
            e.z = (c.z[j] - c.z[middle]) / c.h;
            sph_moments_add(dim, &m, e, sph_test_weights_cspm(KERNEL, dim, sph_length(dim, e), c.V[j]));
        }
        CHECK(sphi_blocks_fill(dim, &m, &b) == 1);
        for (i = 0; i < dim; i++) CHECK_CLOSE((double)b.kk[i][i], 1.0, 8.0 * (double)SPH_EPSILON);
        for (i = 0; i < dim * (dim + 1) / 2; i++)
            CHECK_CLOSE((double)b.mm[i][i], 1.0, 8.0 * (double)SPH_EPSILON);
        cloud_free(&c);
    }
}

/* what is no number in any derivative of this dimension is noticed, and what is of no dimension is not looked at */
static void test_finite(void)
{
    static const int dimension[9] = {1, 2, 3, 1, 2, 2, 3, 3, 3}; /* of x, y, z, xx, xy, yy, xz, yz, zz */
    int dim, a;
    for (dim = 1; dim <= 3; dim++)
        for (a = 0; a < 9; a++) {
            sph_jet j = sph_jet_laplacian(3);
            *jet_at(&j, a) = SPH_R(NAN);
            CHECK(sphi_jet_finite(dim, j) == (dimension[a] > dim));
        }
}

/* pivots are chosen by their size, not by their sign */
static void test_pivots(void)
{
    static const double A[3][3] = {{0, 2, 0.5}, {0, 0.25, -3}, {-4, 0, 0}};
    sph_real b[3];
    sphi_lu s;
    int i, j;
    for (i = 0; i < 3; i++) {
        b[i] = SPH_R(A[i][0] + 2 * A[i][1] + 3 * A[i][2]);
        for (j = 0; j < 3; j++) s.a[i][j] = SPH_R(A[i][j]);
    }
    sphi_lu_factor(3, &s);
    sphi_lu_solve(3, &s, b);
    for (i = 0; i < 3; i++) CHECK_CLOSE((double)b[i], i + 1.0, 16.0 * (double)SPH_EPSILON);
}

int main(void)
{
    test_paper();
    test_misprints();
    test_identity();
    test_exactness();
    test_square();
    test_invariance();
    test_pair_tier();
    test_rows();
    test_other_rows();
    test_singular_kappa();
    test_laplacian();
    test_scales();
    test_finite();
    test_pivots();
    return check_report("test_derivatives");
}
