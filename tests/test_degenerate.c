/* SPDX-License-Identifier: MIT */
/*
 * test_degenerate.c - clouds of which not every derivative can be had: which status every particle gets from the operators that report one, and what the others answer.
 * That nothing is ever a NaN or written where it should not be, and what wrong arguments get, is in CONTRACT.md for all functions.
 *
 * A new function needs an adapter and a line in `functions`; a new cloud a line in degenerate() and in expected().
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

/* ---- the functions, all called through the same arguments ---- */

enum { OUTPUTS = 11 };

typedef struct arguments {
    int k, dim;
    sph_cloud cloud;
    sph_scalars f;
    sph_jet d;
    sph_real least;
    int fallback;
    sph_index left, right;
    sph_real *out[OUTPUTS];
    unsigned char *status;
} arguments;

#define SWEEP (sph_kernel) a->k, a->dim, a->cloud
#define SWEEP_1D (sph_kernel) a->k, a->cloud

static sph_derivatives_out derivative_out(const arguments *a)
{
    return cloud_derivatives_out(a->out, a->status);
}
static sph_scalar_out scalar_out(const arguments *a) { return sph_scalar_out_array(a->out[0], a->status); }
static sph_vector_out vector_out(const arguments *a)
{
    return sph_vector_out_separate(a->out[0], a->out[1], a->out[2]);
}
static sph_derivatives_out gradient_out(const arguments *a)
{
    sph_derivatives_out o = derivative_out(a);
    o.conditioning = a->out[3];
    return o;
}
static sph_gradient_rows_out gradient_row_out(const arguments *a)
{
    sph_gradient_rows_out o = {0};
    o.x = a->out[0];
    o.y = a->out[1];
    o.z = a->out[2];
    o.conditioning = a->out[3];
    o.status = a->status;
    return o;
}
static sph_rows_out row_out(const arguments *a)
{
    sph_rows_out o = {0};
    o.row = a->out[0];
    o.diagonal = a->out[1];
    o.factor = a->out[2];
    o.conditioning = a->out[3];
    o.status = a->status;
    return o;
}

static sph_index shepard_sum(const arguments *a) { return sph_shepard_sum(SWEEP, sph_scalar_out_array(a->out[0], 0)); }
static sph_index interpolate(const arguments *a)
{
    return sph_interpolate_shepard(SWEEP, a->f, scalar_out(a));
}
static sph_index difference(const arguments *a)
{
    return sph_gradient_difference(SWEEP, a->f, vector_out(a));
}
static sph_index gradient(const arguments *a) { return sph_gradient_cspm(SWEEP, a->f, gradient_out(a)); }
static sph_index gradient_rows(const arguments *a)
{
    return sph_gradient_rows_cspm(SWEEP, gradient_row_out(a));
}
static sph_index brookshaw(const arguments *a) { return sph_laplacian_brookshaw(SWEEP, a->f, sph_scalar_out_array(a->out[0], 0)); }
static sph_index brookshaw_rows(const arguments *a) { return sph_laplacian_rows_brookshaw(SWEEP, (sph_rows_out){.row = a->out[0]}); }
static sph_index cspm(const arguments *a) { return sph_derivatives_cspm(SWEEP, a->f, (sph_derivatives_options){.conditioning_min = a->least}, derivative_out(a)); }
static sph_index icspm(const arguments *a) { return sph_derivatives_icspm(SWEEP, a->f, (sph_derivatives_options){.conditioning_min = a->least, .fallback_wls = a->fallback}, derivative_out(a)); }
static sph_index wls(const arguments *a) { return sph_derivatives_wls(SWEEP, a->f, (sph_derivatives_options){.conditioning_min = a->least}, derivative_out(a)); }
static sph_index cspm_rows(const arguments *a) { return sph_derivatives_rows_cspm(SWEEP, a->d, row_out(a)); }
static sph_index icspm_rows(const arguments *a) { return sph_derivatives_rows_icspm(SWEEP, a->d, row_out(a)); }
static sph_index wls_rows(const arguments *a) { return sph_derivatives_rows_wls(SWEEP, a->d, row_out(a)); }
static sph_index bim(const arguments *a)
{
    return sph_second_derivative_bim(SWEEP_1D, a->f, a->left, a->right, scalar_out(a));
}
static sph_index bim_rows(const arguments *a) { return sph_second_derivative_rows_bim(SWEEP_1D, a->left, a->right, (sph_rows_out){.row = a->out[0], .status = a->status}); }

/* what a function has: a dimension, an output for each axis, ends of the domain, a status */
enum { DIM = 1, VECTOR = 2, ENDS = 4, STATUS = 8 };

/* what a function needs around a particle; see need() */
enum { NEEDS_NOTHING, NEEDS_WEIGHT, NEEDS_GRADIENT, NEEDS_CSPM, NEEDS_BOTH, NEEDS_ICSPM_ROW, NEEDS_ENDS };

typedef struct function {
    const char *name;
    sph_index (*call)(const arguments *);
    int has, needs;
    int outputs, per_pair; /* arrays it writes (0: as for derivatives), and how many of them have a number for every pair */
} function;

static const function functions[] = {
    {"sph_shepard_sum", shepard_sum, DIM, NEEDS_NOTHING, 1, 0},
    {"sph_interpolate_shepard", interpolate, DIM | STATUS, NEEDS_WEIGHT, 1, 0},
    {"sph_gradient_difference", difference, DIM | VECTOR, NEEDS_NOTHING, 3, 0},
    {"sph_gradient_cspm", gradient, DIM | VECTOR | STATUS, NEEDS_GRADIENT, 4, 0},
    {"sph_gradient_rows_cspm", gradient_rows, DIM | VECTOR | STATUS, NEEDS_GRADIENT, 4, 3},
    {"sph_laplacian_brookshaw", brookshaw, DIM, NEEDS_NOTHING, 1, 0},
    {"sph_laplacian_rows_brookshaw", brookshaw_rows, DIM, NEEDS_NOTHING, 1, 1},
    {"sph_derivatives_cspm", cspm, DIM | STATUS, NEEDS_CSPM, OUTPUTS, 0},
    {"sph_derivatives_icspm", icspm, DIM | STATUS, NEEDS_BOTH, OUTPUTS, 0},
    {"sph_derivatives_wls", wls, DIM | STATUS, NEEDS_BOTH, OUTPUTS, 0},
    {"sph_derivatives_rows_cspm", cspm_rows, DIM | STATUS, NEEDS_CSPM, 4, 1},
    {"sph_derivatives_rows_icspm", icspm_rows, DIM | STATUS, NEEDS_ICSPM_ROW, 4, 1},
    {"sph_derivatives_rows_wls", wls_rows, DIM | STATUS, NEEDS_BOTH, 4, 1},
    {"sph_second_derivative_bim", bim, ENDS | STATUS, NEEDS_ENDS, 1, 0},
    {"sph_second_derivative_rows_bim", bim_rows, ENDS | STATUS, NEEDS_ENDS, 1, 1},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

static void complain(int line, const function *f, int dim, const char *what, long got, long want)
{
    fprintf(stderr, "test_degenerate.c:%d: failed: %s in %dD, %s: %ld, not %ld\n", line, f->name, dim, what, got, want);
}
static void check_equal_(int line, const function *f, int dim, const char *what, long got, long want)
{
    if (!check_count(got == want)) complain(line, f, dim, what, got, want);
}
#define check_equal(f, dim, what, got, want) check_equal_(__LINE__, f, dim, what, got, want)

/* ---- good arguments on a small cloud, with outputs that are filled with a mark ---- */

typedef struct fixture {
    cloud c;
    arguments a;
    sph_real *hs, *out, *before;
    unsigned char *status;
    size_t room; /* of one output */
} fixture;

static const unsigned char STATUS_MARK = 0xAB;

static void fixture_mark(fixture *t)
{
    size_t i;
    for (i = 0; i < OUTPUTS * t->room; i++) t->out[i] = t->before[i] = SPH_R(-12345.5);
    memset(t->status, STATUS_MARK, (size_t)t->c.n);
}
static fixture fixture_of(cloud c)
{
    fixture t;
    const size_t n = (size_t)c.n;
    size_t i;
    t.c = c;
    t.room = n > (size_t)c.pairs ? n : (size_t)c.pairs;
    t.hs = (sph_real *)cloud_memory(n, sizeof *t.hs);
    t.out = (sph_real *)cloud_memory(2 * OUTPUTS * t.room, sizeof *t.out);
    t.before = t.out + OUTPUTS * t.room;
    t.status = (unsigned char *)cloud_memory(n, 1);
    for (i = 0; i < n; i++) t.hs[i] = c.h;
    t.a.k = SPH_WENDLAND_C4_1D;
    t.a.dim = c.dim;
    t.a.cloud = cloud_view(&c);
    t.a.cloud.h = sph_scalars_array(t.hs);
    t.a.f = cloud_f(&c);
    t.a.d = sph_jet_laplacian(3);
    t.a.least = SPH_R(0);
    t.a.fallback = 0;
    t.a.left = 0;
    t.a.right = c.n - 1;
    for (i = 0; i < OUTPUTS; i++) t.a.out[i] = t.out + i * t.room;
    t.a.status = t.status;
    fixture_mark(&t);
    return t;
}
static void fixture_free(fixture *t)
{
    free(t->hs);
    free(t->out);
    free(t->status);
    cloud_free(&t->c);
}

/* ---- outputs: finite where they are written, and written nowhere else ---- */

static void check_outputs(const function *f, const fixture *t, const char *what, sph_index answer, int may_overflow)
{
    const arguments *const a = &t->a;
    const int dim = a->dim;
    const sph_index from = t->c.start[a->cloud.first], to = t->c.start[a->cloud.last];
    sph_index failed = 0, j;
    long bad = 0, stray = 0;
    int o;
    for (o = 0; o < OUTPUTS; o++) {
        const int pairs = o < f->per_pair;
        const sph_index lo = pairs ? from : a->cloud.first, hi = pairs ? to : a->cloud.last;
        int written = o < f->outputs;
        if (f->outputs == OUTPUTS) written = o < 3 ? o < dim : o < 9 ? o - 3 < field_hessian_components(dim) : 1;
        else if ((f->has & VECTOR) && o < 3) written = o < dim;
        for (j = 0; j < (sph_index)t->room; j++) {
            const sph_real v = a->out[o][j];
            const int same = memcmp(&v, &t->before[0], sizeof v) == 0;
            if (written && j >= lo && j < hi) bad += same || !isfinite(v);
            else stray += !same;
        }
    }
    check_equal(f, dim, what, bad, 0);
    check_equal(f, dim, what, stray, 0);
    if (!(f->has & STATUS)) { /* only an overflow can fail here: a zero then */
        for (j = a->cloud.first; j < a->cloud.last; j++) {
            int zero = 0;
            for (o = 0; o < (f->has & VECTOR ? dim : 1) && !f->per_pair; o++) zero |= !(fabs((double)a->out[o][j]) > 0.0);
            failed += zero;
        }
        check_equal(f, dim, what,
                    answer >= 0 && answer <= (f->per_pair ? a->cloud.last - a->cloud.first : failed), 1);
        if (may_overflow) return;
        check_equal(f, dim, what, (long)answer, 0);
        return;
    }
    for (j = 0; j < t->c.n; j++) {
        if (j < a->cloud.first || j >= a->cloud.last) stray += t->status[j] != STATUS_MARK;
        else {
            failed += t->status[j] != SPH_OK;
            bad += t->status[j] > SPH_NOT_FINITE;
        }
    }
    check_equal(f, dim, what, bad, 0);
    check_equal(f, dim, what, stray, 0);
    check_equal(f, dim, what, (long)answer, (long)failed);
    for (j = a->cloud.first; j < a->cloud.last; j++) { /* nothing but zeros where there is no answer */
        const unsigned char s = t->status[j];
        sph_index p;
        if (s != SPH_TOO_FEW && s != SPH_SINGULAR && s != SPH_NOT_AVAILABLE && s != SPH_NOT_FINITE) continue;
        for (o = 0; o < f->outputs; o++) {
            const int conditioning = (f->outputs == OUTPUTS && o == 10) || (f->outputs == 4 && o == 3);
            if (conditioning || memcmp(&a->out[o][o < f->per_pair ? from : j], &t->before[0], sizeof(sph_real)) == 0) continue;
            if (o >= f->per_pair) bad += fabs((double)a->out[o][j]) > 0.0;
            else
                for (p = t->c.start[j]; p < t->c.start[j + 1]; p++) bad += fabs((double)a->out[o][p]) > 0.0;
        }
    }
    check_equal(f, dim, what, bad, 0);
}

/* ---- degenerate clouds ---- */

enum { ISOLATED, FAR_APART, PAIR, TRIPLE, COINCIDENT, LINE, PLANE, TWIN, F_HUGE, F_TINY, F_LIMIT, V_HUGE, V_TINY, V_0, V_NEGATIVE, CLOUDS };
static const char *const cloud_name[CLOUDS] = {"isolated", "far apart", "pair", "triple", "coincident", "line",  "plane", "twin", "huge f",
                                               "tiny f",   "f at the limit", "huge V", "tiny V", "V = 0", "negative V"};

static cloud degenerate(int kind, int dim)
{
    static const double direction[3] = {0.48, 0.6, 0.64};
    const double huge = BY_PRECISION(1e150, 1e30), tiny = BY_PRECISION(1e-150, 1e-30);
    static const sph_index count[] = {1, 3, 2, 3, 12, 12, 16};
    const double limit = SPH_SINGLE ? (double)FLT_MAX : DBL_MAX;
    cloud c;
    sph_index i;
    if (kind <= PLANE) {
        c = cloud_new(dim, count[kind]);
        for (i = 0; i < c.n; i++) {
            /* all within the support, at uneven distances; or all at the same place; or out of reach */
            const double s = kind == FAR_APART ? 10.0 * (double)i : kind == COINCIDENT ? 0.5 : 0.1 * (double)i + 0.003 * (double)(i * i), u = (double)(i / 4), v = (double)(i % 4);
            c.x[i] = SPH_R(kind == PLANE ? 0.3 * u + 0.05 * v : 0.2 + direction[0] * s);
            c.y[i] = SPH_R(kind == PLANE ? 0.2 * v - 0.1 * u : 0.1 + direction[1] * s);
            c.z[i] = SPH_R(kind == PLANE ? 0.7 * (double)c.x[i] + 0.4 * (double)c.y[i] : 0.3 + direction[2] * s);
            c.V[i] = SPH_R(0.1 + 0.01 * (double)(i % 3));
        }
        c.dx = 0.1;
        c.h = SPH_R(1);
        cloud_neighbors(&c, kind == FAR_APART ? 100.0 : 3.0); /* in the list, though out of reach; or the longest support */
    } else {
        c = cloud_lattice(dim, 5, 2.0, 0.1, 4);
        if (kind == TWIN) {
            const sph_index j = c.n / 2;
            c.x[j] = c.x[j + 1];
            c.y[j] = c.y[j + 1];
            c.z[j] = c.z[j + 1];
        }
        cloud_neighbors(&c, 3.0 * (double)c.h);
    }
    cloud_set(&c, field_smooth);
    for (i = 0; i < c.n; i++) {
        const double f = (double)c.f[i], V = (double)c.V[i];
        if (kind == F_HUGE) c.f[i] = SPH_R(huge * f);
        if (kind == F_TINY) c.f[i] = SPH_R(tiny * f);
        if (kind == F_LIMIT) c.f[i] = SPH_R(i % 2 ? limit : 0.25 * limit);
        if (kind == V_HUGE) c.V[i] = SPH_R(huge * V);
        if (kind == V_TINY) c.V[i] = SPH_R(tiny * V);
        if (kind == V_0) c.V[i] = SPH_R(0);
        if (kind == V_NEGATIVE) c.V[i] = SPH_R(-V);
    }
    return c;
}

/* The status of every particle, or -1 where it may be one or the other. */
static int expected(const function *f, int kind, int dim)
{
    const int nh = field_hessian_components(dim);
    const int needed = f->needs == NEEDS_GRADIENT ? dim : f->needs == NEEDS_CSPM ? nh : dim + nh;
    int others;
    if (f->needs == NEEDS_NOTHING || f->needs == NEEDS_ENDS) return -1;
    if (f->needs == NEEDS_WEIGHT) return kind == V_0 || kind == V_NEGATIVE ? SPH_TOO_FEW : kind == F_LIMIT ? -1 : SPH_OK;
    switch (kind) {
    case ISOLATED:
    case FAR_APART:
    case COINCIDENT: return SPH_TOO_FEW;
    case PAIR: others = 1; break;
    case TRIPLE: others = 2; break;
    case LINE: others = 11; break;
    case PLANE: return dim < 3 ? -1 : SPH_SINGULAR;
    case V_0:
    case V_NEGATIVE: return SPH_SINGULAR;
    case F_LIMIT: return -1;
    default: return SPH_OK;
    }
    if (dim == 1 && f->needs == NEEDS_ICSPM_ROW) return SPH_OK; /* it never divides by kappa */
    return others < needed ? SPH_TOO_FEW : dim > 1 ? SPH_SINGULAR : SPH_OK;
}

static void test_degenerate(void)
{
    static const int kernels[] = {SPH_WENDLAND_C4_1D, SPH_CUBIC_SPLINE, SPH_CONVEX, SPH_GAUSSIAN}; /* one has a cusp, one ends at 3 h */
    int i, kind, dim;
    size_t k;
    for (kind = 0; kind < CLOUDS; kind++)
        for (dim = 1; dim <= 3; dim++)
            for (i = 0; i < FUNCTIONS; i++)
                for (k = 0; k < sizeof kernels / sizeof *kernels; k++) {
                    const function *const f = &functions[i];
                    fixture t;
                    sph_index answer, j;
                    int state;
                    if (dim > 1 && !(f->has & DIM)) continue;
                    t = fixture_of(degenerate(kind, dim));
                    t.a.k = kernels[k];
                    if ((f->has & ENDS) && (kind == ISOLATED || kind == COINCIDENT)) {
                        check_equal(f, dim, cloud_name[kind], (long)f->call(&t.a), SPH_ERROR_POSITION);
                        fixture_free(&t);
                        continue;
                    }
                    answer = f->call(&t.a);
                    if (kind == F_LIMIT && f->call == brookshaw && k == 0) CHECK(answer > 0); /* such sums overflow: that is counted */
                    check_outputs(f, &t, cloud_name[kind], answer, kind == F_LIMIT);
                    state = expected(f, kind, dim);
                    if (state >= 0 && (f->has & STATUS)) {
                        for (j = 0; j < t.c.n && t.status[j] == state; j++) {}
                        if (j < t.c.n) check_equal(f, dim, cloud_name[kind], t.status[j], state);
                        else check_count(1);
                    }
                    if (kind == PAIR && f->needs == NEEDS_ICSPM_ROW && dim == 1) CHECK_CLOSE((double)t.a.out[2][0], 0.0, 100.0 * (double)SPH_EPSILON);
                    if (kind == PAIR && f->call == cspm && dim == 1) /* one neighbour: what can be said is the difference quotient, and no curvature */
                        CHECK_RELATIVE((double)t.a.out[0][0], ((double)t.c.f[1] - (double)t.c.f[0]) / ((double)t.c.x[1] - (double)t.c.x[0]), BY_PRECISION(1e-12, 1e-5));
                    if (kind == ISOLATED && f->call == interpolate) CHECK_RELATIVE((double)t.a.out[0][0], (double)t.c.f[0], 8.0 * (double)SPH_EPSILON);

                    if (f->call == icspm && kind != F_LIMIT) { /* the fallback saves no one who has no neighbours */
                        t.a.least = SPH_R(0.2);
                        t.a.fallback = 1;
                        fixture_mark(&t);
                        check_outputs(f, &t, cloud_name[kind], f->call(&t.a), 0);
                        for (j = 0; j < t.c.n; j++)
                            if (state == SPH_TOO_FEW || state == SPH_SINGULAR) check_equal(f, dim, cloud_name[kind], t.status[j], state);
                    }
                    fixture_free(&t);
                }
}

/* BIM's own cases */
static void test_bim(void)
{
    int rows;
    for (rows = 0; rows < 2; rows++) {
        const function *const f = &functions[FUNCTIONS - 2 + rows];
        static const double at[] = {0.0, 0.5, 1.0, 0.1, 1.2};
        cloud c = cloud_new(1, 5);
        fixture t;
        int i;
        for (i = 0; i < 5; i++) {
            c.x[i] = SPH_R(at[i]);
            c.V[i] = SPH_R(0.2);
            c.f[i] = SPH_R(i);
        }
        c.h = SPH_R(0.125);
        cloud_neighbors(&c, 0.25);
        t = fixture_of(c);
        t.a.right = 2;
        check_equal(f, 1, "lonely", (long)f->call(&t.a), 4);
        CHECK(t.status[0] == SPH_NOT_AVAILABLE && t.status[1] == SPH_TOO_FEW && t.status[2] == SPH_NOT_AVAILABLE && t.status[3] == SPH_OK && t.status[4] == SPH_NOT_AVAILABLE);
        check_outputs(f, &t, "lonely", f->call(&t.a), 0);
        t.a.left = 2;
        t.a.right = 0;
        check_equal(f, 1, "ends swapped", (long)f->call(&t.a), SPH_ERROR_POSITION);
        t.a.left = 0;
        check_equal(f, 1, "ends equal", (long)f->call(&t.a), SPH_ERROR_POSITION);
        fixture_free(&t);
    }
}

int main(void)
{
    test_degenerate();
    test_bim();
    return check_report("test_degenerate");
}
