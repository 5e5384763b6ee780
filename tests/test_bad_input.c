/* SPDX-License-Identifier: MIT */
/*
 * test_bad_input.c - every list-tier function refuses what is wrong, with the right code and without touching its outputs, and survives what is legal but degenerate:
 * the status says so, and nothing is ever a NaN.
 *
 * A new function needs an adapter and a line in `functions`; a new fault a line in `faults` and in spoil().
 */
/* Not forced inline: kernels and dimensions are run-time values here, and one copy of each function is enough. */
#if defined(__GNUC__) || defined(__clang__)
#  define SPH_FN static __attribute__((noinline, unused))
#endif
#if defined(__clang__)
#  pragma clang diagnostic ignored "-Wpass-failed" /* loops over a run-time kernel do not vectorise */
#endif

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
    sph_index first, last;
    sph_points x;
    sph_list list;
    sph_scalars h, V, f;
    sph_jet d;
    sph_real least;
    int fallback;
    sph_index left, right;
    sph_real *out[OUTPUTS];
    unsigned char *status;
} arguments;

#define SWEEP (sph_kernel)a->k, a->dim, a->first, a->last, a->x, a->list, a->h, a->V
#define SWEEP_1D (sph_kernel)a->k, a->first, a->last, a->x, a->list, a->h, a->V

static sph_derivative_out derivative_out(const arguments *a)
{
    sph_derivative_out o;
    o.gx = a->out[0];
    o.gy = a->out[1];
    o.gz = a->out[2];
    o.hxx = a->out[3];
    o.hxy = a->out[4];
    o.hyy = a->out[5];
    o.hxz = a->out[6];
    o.hyz = a->out[7];
    o.hzz = a->out[8];
    o.laplacian = a->out[9];
    o.conditioning = a->out[10];
    o.stride = 1;
    o.status = a->status;
    return o;
}
static sph_row_out row_out(const arguments *a)
{
    sph_row_out o;
    o.row = a->out[0];
    o.diagonal = a->out[1];
    o.factor = a->out[2];
    o.conditioning = a->out[3];
    o.status = a->status;
    return o;
}

static sph_index shepard_sum(const arguments *a) { return sph_shepard_sum(SWEEP, a->out[0]); }
static sph_index interpolate(const arguments *a) { return sph_interpolate_shepard(SWEEP, a->f, a->out[0], a->status); }
static sph_index difference(const arguments *a) { return sph_gradient_difference(SWEEP, a->f, a->out[0], a->out[1], a->out[2]); }
static sph_index gradient(const arguments *a) { return sph_gradient_cspm(SWEEP, a->f, a->out[0], a->out[1], a->out[2], a->out[3], a->status); }
static sph_index gradient_rows(const arguments *a) { return sph_gradient_rows_cspm(SWEEP, a->out[0], a->out[1], a->out[2], a->out[3], a->status); }
static sph_index brookshaw(const arguments *a) { return sph_laplacian_brookshaw(SWEEP, a->f, a->out[0]); }
static sph_index brookshaw_rows(const arguments *a) { return sph_laplacian_rows_brookshaw(SWEEP, a->out[0]); }
static sph_index kernel_laplacian(const arguments *a) { return sph_laplacian_kernel(SWEEP, a->f, a->out[0]); }
static sph_index kernel_rows(const arguments *a) { return sph_laplacian_rows_kernel(SWEEP, a->out[0]); }
static sph_index cspm(const arguments *a) { return sph_derivatives_cspm(SWEEP, a->f, a->least, derivative_out(a)); }
static sph_index icspm(const arguments *a) { return sph_derivatives_icspm(SWEEP, a->f, a->least, a->fallback, derivative_out(a)); }
static sph_index wls(const arguments *a) { return sph_derivatives_wls(SWEEP, a->f, a->least, derivative_out(a)); }
static sph_index cspm_rows(const arguments *a) { return sph_derivative_rows_cspm(SWEEP, a->d, row_out(a)); }
static sph_index icspm_rows(const arguments *a) { return sph_derivative_rows_icspm(SWEEP, a->d, row_out(a)); }
static sph_index wls_rows(const arguments *a) { return sph_derivative_rows_wls(SWEEP, a->d, row_out(a)); }
static sph_index bim(const arguments *a) { return sph_second_derivative_bim(SWEEP_1D, a->f, a->left, a->right, a->out[0], a->status); }
static sph_index bim_rows(const arguments *a) { return sph_second_derivative_rows_bim(SWEEP_1D, a->left, a->right, a->out[0], a->status); }

/* what a function has, and so what can be wrong with it */
enum { ANY = 0, DIM = 1, FIELD = 2, VECTOR = 4, SCALAR = 8, LEAST = 16, OPERATOR = 32, ENDS = 64, STATUS = 128, TWO = 256, THREE = 512 };

/* what a function needs around a particle; see need() */
enum { NEEDS_NOTHING, NEEDS_WEIGHT, NEEDS_GRADIENT, NEEDS_CSPM, NEEDS_BOTH, NEEDS_ICSPM_ROW, NEEDS_ENDS };

typedef struct function {
    const char *name;
    sph_index (*call)(const arguments *);
    int has, needs;
    int outputs, per_pair; /* arrays it writes (0: as for derivatives), and how many of them have a number for every pair */
} function;

static const function functions[] = {
    {"sph_shepard_sum", shepard_sum, DIM | SCALAR, NEEDS_NOTHING, 1, 0},
    {"sph_interpolate_shepard", interpolate, DIM | SCALAR | FIELD | STATUS, NEEDS_WEIGHT, 1, 0},
    {"sph_gradient_difference", difference, DIM | VECTOR | FIELD, NEEDS_NOTHING, 3, 0},
    {"sph_gradient_cspm", gradient, DIM | VECTOR | FIELD | STATUS, NEEDS_GRADIENT, 4, 0},
    {"sph_gradient_rows_cspm", gradient_rows, DIM | VECTOR | STATUS, NEEDS_GRADIENT, 4, 3},
    {"sph_laplacian_brookshaw", brookshaw, DIM | SCALAR | FIELD, NEEDS_NOTHING, 1, 0},
    {"sph_laplacian_rows_brookshaw", brookshaw_rows, DIM | SCALAR, NEEDS_NOTHING, 1, 1},
    {"sph_laplacian_kernel", kernel_laplacian, DIM | SCALAR | FIELD, NEEDS_NOTHING, 1, 0},
    {"sph_laplacian_rows_kernel", kernel_rows, DIM | SCALAR, NEEDS_NOTHING, 1, 1},
    {"sph_derivatives_cspm", cspm, DIM | FIELD | LEAST | STATUS, NEEDS_CSPM, OUTPUTS, 0},
    {"sph_derivatives_icspm", icspm, DIM | FIELD | LEAST | STATUS, NEEDS_BOTH, OUTPUTS, 0},
    {"sph_derivatives_wls", wls, DIM | FIELD | LEAST | STATUS, NEEDS_BOTH, OUTPUTS, 0},
    {"sph_derivative_rows_cspm", cspm_rows, DIM | SCALAR | OPERATOR | STATUS, NEEDS_CSPM, 4, 1},
    {"sph_derivative_rows_icspm", icspm_rows, DIM | SCALAR | OPERATOR | STATUS, NEEDS_ICSPM_ROW, 4, 1},
    {"sph_derivative_rows_wls", wls_rows, DIM | SCALAR | OPERATOR | STATUS, NEEDS_BOTH, 4, 1},
    {"sph_second_derivative_bim", bim, SCALAR | FIELD | ENDS | STATUS, NEEDS_ENDS, 1, 0},
    {"sph_second_derivative_rows_bim", bim_rows, SCALAR | ENDS | STATUS, NEEDS_ENDS, 1, 1},
};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

static void complain(int line, const function *f, int dim, const char *what, long got, long want)
{
    fprintf(stderr, "test_bad_input.c:%d: failed: %s in %dD, %s: %ld, not %ld\n", line, f->name, dim, what, got, want);
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
    t.a.first = 0;
    t.a.last = c.n;
    t.a.x = cloud_points(&c);
    t.a.list = cloud_list(&c);
    t.a.h = sph_scalars_array(t.hs);
    t.a.V = cloud_V(&c);
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
static int fixture_untouched(const fixture *t)
{
    size_t i;
    for (i = 0; i < (size_t)t->c.n; i++)
        if (t->status[i] != STATUS_MARK) return 0;
    return memcmp(t->out, t->before, OUTPUTS * t->room * sizeof *t->out) == 0;
}
static void fixture_free(fixture *t)
{
    free(t->hs);
    free(t->out);
    free(t->status);
    cloud_free(&t->c);
}

/* ---- faults ---- */

enum {
    NO_X, NO_Y, NO_Z, NO_START, NO_INDEX, NO_H, NO_V, NO_F, NO_OUT, NO_OUT_Y, NO_OUT_Z,
    N_0, N_NEGATIVE, STRIDE_0, DIM_0, DIM_4, DIM_NEGATIVE, KERNEL_NEGATIVE, KERNEL_COUNT,
    H_0, H_NEGATIVE, H_NAN, H_INF, H_SAME_0, H_SAME_NAN,
    X_NAN, X_INF, Y_NAN, Z_INF, F_NAN, F_INF, F_NEGATIVE_INF, V_NAN, V_INF, V_SAME_NAN,
    INDEX_NEGATIVE, INDEX_N, INDEX_SELF, START_DESCENDS, START_NEGATIVE,
    FIRST_NEGATIVE, FIRST_AFTER_LAST, LAST_AFTER_N,
    LEFT_NEGATIVE, LEFT_N, RIGHT_NEGATIVE, RIGHT_N, ENDS_SWAPPED, ENDS_EQUAL,
    LEAST_NEGATIVE, LEAST_NAN, LEAST_INF, OPERATOR_NAN, OPERATOR_INF
};

static const struct {
    int fault, in, error; /* `in`: only functions and dimensions that have all of this */
    const char *name;
} faults[] = {
    {NO_X, ANY, SPH_ERROR_NULL, "no x"},
    {NO_Y, TWO, SPH_ERROR_NULL, "no y"},
    {NO_Z, THREE, SPH_ERROR_NULL, "no z"},
    {NO_START, ANY, SPH_ERROR_NULL, "no start"},
    {NO_INDEX, ANY, SPH_ERROR_NULL, "no index"},
    {NO_H, ANY, SPH_ERROR_NULL, "no h"},
    {NO_V, ANY, SPH_ERROR_NULL, "no V"},
    {NO_F, FIELD, SPH_ERROR_NULL, "no f"},
    {NO_OUT, SCALAR, SPH_ERROR_NULL, "no output"},
    {NO_OUT, VECTOR, SPH_ERROR_NULL, "no output x"},
    {NO_OUT_Y, VECTOR | TWO, SPH_ERROR_NULL, "no output y"},
    {NO_OUT_Z, VECTOR | THREE, SPH_ERROR_NULL, "no output z"},
    {N_0, ANY, SPH_ERROR_COUNT, "n = 0"},
    {N_NEGATIVE, ANY, SPH_ERROR_COUNT, "n = -1"},
    {STRIDE_0, ANY, SPH_ERROR_COUNT, "stride 0"},
    {DIM_0, DIM, SPH_ERROR_DIM, "dim 0"},
    {DIM_4, DIM, SPH_ERROR_DIM, "dim 4"},
    {DIM_NEGATIVE, DIM, SPH_ERROR_DIM, "dim -1"},
    {KERNEL_NEGATIVE, ANY, SPH_ERROR_KERNEL, "kernel -1"},
    {KERNEL_COUNT, ANY, SPH_ERROR_KERNEL, "kernel SPH_KERNEL_COUNT"},
    {H_0, ANY, SPH_ERROR_H, "h = 0"},
    {H_NEGATIVE, ANY, SPH_ERROR_H, "h < 0"},
    {H_NAN, ANY, SPH_ERROR_H, "h NaN"},
    {H_INF, ANY, SPH_ERROR_H, "h infinite"},
    {H_SAME_0, ANY, SPH_ERROR_H, "h = 0 for all"},
    {H_SAME_NAN, ANY, SPH_ERROR_H, "h NaN for all"},
    {X_NAN, ANY, SPH_ERROR_POSITION, "x NaN"},
    {X_INF, ANY, SPH_ERROR_POSITION, "x infinite"},
    {Y_NAN, TWO, SPH_ERROR_POSITION, "y NaN"},
    {Z_INF, THREE, SPH_ERROR_POSITION, "z infinite"},
    {F_NAN, FIELD, SPH_ERROR_VALUE, "f NaN"},
    {F_INF, FIELD, SPH_ERROR_VALUE, "f infinite"},
    {F_NEGATIVE_INF, FIELD, SPH_ERROR_VALUE, "f minus infinite"},
    {V_NAN, ANY, SPH_ERROR_VALUE, "V NaN"},
    {V_INF, ANY, SPH_ERROR_VALUE, "V infinite"},
    {V_SAME_NAN, ANY, SPH_ERROR_VALUE, "V NaN for all"},
    {INDEX_NEGATIVE, ANY, SPH_ERROR_LIST, "index -1"},
    {INDEX_N, ANY, SPH_ERROR_LIST, "index n"},
    {INDEX_SELF, ANY, SPH_ERROR_SELF, "itself in its list"},
    {START_DESCENDS, ANY, SPH_ERROR_LIST, "start descends"},
    {START_NEGATIVE, ANY, SPH_ERROR_LIST, "start negative"},
    {FIRST_NEGATIVE, ANY, SPH_ERROR_RANGE, "first < 0"},
    {FIRST_AFTER_LAST, ANY, SPH_ERROR_RANGE, "first > last"},
    {LAST_AFTER_N, ANY, SPH_ERROR_RANGE, "last > n"},
    {LEFT_NEGATIVE, ENDS, SPH_ERROR_RANGE, "left -1"},
    {LEFT_N, ENDS, SPH_ERROR_RANGE, "left n"},
    {RIGHT_NEGATIVE, ENDS, SPH_ERROR_RANGE, "right -1"},
    {RIGHT_N, ENDS, SPH_ERROR_RANGE, "right n"},
    {ENDS_SWAPPED, ENDS, SPH_ERROR_POSITION, "ends swapped"},
    {ENDS_EQUAL, ENDS, SPH_ERROR_POSITION, "ends equal"},
    {LEAST_NEGATIVE, LEAST, SPH_ERROR_VALUE, "conditioning_min < 0"},
    {LEAST_NAN, LEAST, SPH_ERROR_VALUE, "conditioning_min NaN"},
    {LEAST_INF, LEAST, SPH_ERROR_VALUE, "conditioning_min infinite"},
    {OPERATOR_NAN, OPERATOR, SPH_ERROR_VALUE, "operator NaN"},
    {OPERATOR_INF, OPERATOR, SPH_ERROR_VALUE, "operator infinite"},
};
enum { FAULTS = sizeof faults / sizeof *faults };

static void spoil(int fault, fixture *t, sph_real *scratch)
{
    arguments *const a = &t->a;
    cloud *const c = &t->c;
    const sph_index n = c->n;
    switch (fault) {
    case NO_X: a->x.x = 0; break;
    case NO_Y: a->x.y = 0; break;
    case NO_Z: a->x.z = 0; break;
    case NO_START: a->list.start = 0; break;
    case NO_INDEX: a->list.index = 0; break;
    case NO_H: a->h.p = 0; break;
    case NO_V: a->V.p = 0; break;
    case NO_F: a->f.p = 0; break;
    case NO_OUT: a->out[0] = 0; break;
    case NO_OUT_Y: a->out[1] = 0; break;
    case NO_OUT_Z: a->out[2] = 0; break;
    case N_0: a->x.n = 0; break;
    case N_NEGATIVE: a->x.n = -1; break;
    case STRIDE_0: a->x.stride = 0; break;
    case DIM_0: a->dim = 0; break;
    case DIM_4: a->dim = 4; break;
    case DIM_NEGATIVE: a->dim = -1; break;
    case KERNEL_NEGATIVE: a->k = -1; break;
    case KERNEL_COUNT: a->k = SPH_KERNEL_COUNT; break;
    case H_0: t->hs[n - 1] = SPH_R(0); break;
    case H_NEGATIVE: t->hs[n / 2] = -t->hs[n / 2]; break;
    case H_NAN: t->hs[0] = SPH_R(NAN); break;
    case H_INF: t->hs[n - 1] = SPH_R(INFINITY); break;
    case H_SAME_0: a->h = sph_scalars_same(scratch); break;
    case H_SAME_NAN: *scratch = SPH_R(NAN), a->h = sph_scalars_same(scratch); break;
    case X_NAN: c->x[n - 1] = SPH_R(NAN); break;
    case X_INF: c->x[0] = SPH_R(-INFINITY); break;
    case Y_NAN: c->y[n / 2] = SPH_R(NAN); break;
    case Z_INF: c->z[n - 1] = SPH_R(INFINITY); break;
    case F_NAN: c->f[n - 1] = SPH_R(NAN); break;
    case F_INF: c->f[0] = SPH_R(INFINITY); break;
    case F_NEGATIVE_INF: c->f[n / 2] = SPH_R(-INFINITY); break;
    case V_NAN: c->V[0] = SPH_R(NAN); break;
    case V_INF: c->V[n - 1] = SPH_R(INFINITY); break;
    case V_SAME_NAN: *scratch = SPH_R(NAN), a->V = sph_scalars_same(scratch); break;
    case INDEX_NEGATIVE: c->index[c->pairs - 1] = -1; break;
    case INDEX_N: c->index[0] = n; break;
    case INDEX_SELF: c->index[c->start[n - 1]] = n - 1; break;
    case START_DESCENDS: c->start[1] = c->start[2] + 1; break;
    case START_NEGATIVE: c->start[0] = -1; break;
    case FIRST_NEGATIVE: a->first = -1; break;
    case FIRST_AFTER_LAST: a->first = 2, a->last = 1; break;
    case LAST_AFTER_N: a->last = n + 1; break;
    case LEFT_NEGATIVE: a->left = -1; break;
    case LEFT_N: a->left = n; break;
    case RIGHT_NEGATIVE: a->right = -1; break;
    case RIGHT_N: a->right = n; break;
    case ENDS_SWAPPED: a->left = n - 1, a->right = 0; break;
    case ENDS_EQUAL: a->left = a->right; break;
    case LEAST_NEGATIVE: a->least = SPH_R(-0.1); break;
    case LEAST_NAN: a->least = SPH_R(NAN); break;
    case LEAST_INF: a->least = SPH_R(INFINITY); break;
    case OPERATOR_NAN: a->d.gradient.x = SPH_R(NAN); break;
    case OPERATOR_INF: a->d.hessian.xx = SPH_R(INFINITY); break;
    default: CHECK(0); break;
    }
}

static int has_all(const function *f, int dim, int in)
{
    const int has = f->has | (dim > 1 ? TWO : 0) | (dim > 2 ? THREE : 0);
    return (has & in) == in && (dim == 1 || (f->has & DIM));
}

static void test_faults(void)
{
    int i, b, dim;
    for (dim = 1; dim <= 3; dim++)
        for (i = 0; i < FUNCTIONS; i++)
            for (b = 0; b < FAULTS; b++) {
                const function *const f = &functions[i];
                sph_real scratch = SPH_R(0);
                fixture t;
                if (!has_all(f, dim, faults[b].in)) continue;
                t = fixture_of(cloud_lattice(dim, dim == 1 ? 7 : 4, 2.0, 0.1, 1));
                cloud_set(&t.c, field_smooth);
                spoil(faults[b].fault, &t, &scratch);
                check_equal(f, dim, faults[b].name, (long)f->call(&t.a), faults[b].error);
                if (!check_count(fixture_untouched(&t))) complain(__LINE__, f, dim, faults[b].name, 1, 0);
                fixture_free(&t);
            }
}

/* ---- outputs: finite where they are written, and written nowhere else ---- */

static void check_outputs(const function *f, const fixture *t, const char *what, sph_index answer, int may_overflow)
{
    const arguments *const a = &t->a;
    const int dim = a->dim;
    const sph_index from = t->c.start[a->first], to = t->c.start[a->last];
    sph_index failed = 0, j;
    long bad = 0, stray = 0;
    int o;
    for (o = 0; o < OUTPUTS; o++) {
        const int pairs = o < f->per_pair;
        const sph_index lo = pairs ? from : a->first, hi = pairs ? to : a->last;
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
        for (j = a->first; j < a->last; j++) {
            int zero = 0;
            for (o = 0; o < (f->has & VECTOR ? dim : 1) && !f->per_pair; o++) zero |= !(fabs((double)a->out[o][j]) > 0.0);
            failed += zero;
        }
        check_equal(f, dim, what, answer >= 0 && answer <= (f->per_pair ? a->last - a->first : failed), 1);
        if (may_overflow) return;
        check_equal(f, dim, what, (long)answer, 0);
        return;
    }
    for (j = 0; j < t->c.n; j++) {
        if (j < a->first || j >= a->last) stray += t->status[j] != STATUS_MARK;
        else {
            failed += t->status[j] != SPH_OK;
            bad += t->status[j] > SPH_NOT_FINITE;
        }
    }
    check_equal(f, dim, what, bad, 0);
    check_equal(f, dim, what, stray, 0);
    check_equal(f, dim, what, (long)answer, (long)failed);
    for (j = a->first; j < a->last; j++) { /* nothing but zeros where there is no answer */
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

/* ---- legal, though unusual ---- */

static void test_legal(void)
{
    int i, dim;
    for (dim = 1; dim <= 3; dim++)
        for (i = 0; i < FUNCTIONS; i++) {
            const function *const f = &functions[i];
            const int failures = f->has & ENDS ? 2 : 0;
            fixture t;
            sph_index n;
            if (!has_all(f, dim, ANY)) continue;
            t = fixture_of(cloud_lattice(dim, dim == 1 ? 7 : 4, 2.0, 0.1, 1));
            cloud_set(&t.c, field_smooth);
            n = t.c.n;
            t.a.last = 0; /* an empty range, at either end */
            check_equal(f, dim, "empty range", (long)f->call(&t.a), 0);
            t.a.first = t.a.last = n;
            check_equal(f, dim, "empty range", (long)f->call(&t.a), 0);
            if (!check_count(fixture_untouched(&t))) complain(__LINE__, f, dim, "empty range", 1, 0);

            t.a.first = 1;
            t.a.last = n - 1;
            check_outputs(f, &t, "part", f->call(&t.a), 0);
            fixture_mark(&t);
            t.a.first = 0;
            t.a.last = n;
            check_equal(f, dim, "all", (long)f->call(&t.a), failures);
            check_outputs(f, &t, "all", f->call(&t.a), 0);

            /* what is not read may be missing: coordinates and outputs beyond dim; status; conditioning */
            t.a.status = 0;
            if (dim < 2) t.a.x.y = t.a.out[1] = 0;
            if (dim < 3) t.a.x.z = t.a.out[2] = 0;
            if (f->outputs == OUTPUTS) memset(t.a.out, 0, sizeof t.a.out);
            if (f->outputs == 4) t.a.out[3] = 0;
            if (f->has & OPERATOR) t.a.out[1] = t.a.out[2] = 0;
            check_equal(f, dim, "less", (long)f->call(&t.a), failures);
            t.a.status = t.status;

            /* a row out of the range is none of this call's business; an empty index array needs no address */
            t.c.index[t.c.start[n - 1]] = -7;
            t.a.last = n - 1;
            check_equal(f, dim, "bad row elsewhere", (long)f->call(&t.a), f->has & ENDS ? 1 : 0);
            t.a.list.index = 0;
            memset(t.c.start, 0, ((size_t)n + 1) * sizeof *t.c.start);
            if (!check_count(f->call(&t.a) >= 0)) complain(__LINE__, f, dim, "empty lists without an address", -1, 0);
            fixture_free(&t);
        }
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
                    if (!has_all(f, dim, ANY)) continue;
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
        fixture_free(&t);
    }
}

/* ---- neighbour search ---- */

static void test_grid_build(void)
{
    enum { N = 7 };
    static const sph_real wrong[] = {SPH_R(0), SPH_R(-1), SPH_R(NAN), SPH_R(INFINITY)};
    sph_real x[N], y[N], z[N];
    const sph_real reach = SPH_R(0.3);
    sph_points p, q;
    sph_grid g, untouched;
    int i, dim, which;

    CHECK(sph_grid_workspace(0, N) == 0);
    CHECK(sph_grid_workspace(4, N) == 0);
    CHECK(sph_grid_workspace(-1, N) == 0);
    memset(&g, 0x55, sizeof g);
    memset(&untouched, 0x55, sizeof untouched);
    for (i = 0; i < N; i++) {
        x[i] = SPH_R(0.1 * i);
        y[i] = SPH_R(0.05 * i);
        z[i] = SPH_R(0.02 * i);
    }
    p = sph_points_separate(N, x, y, z);
    for (dim = 1; dim <= 3; dim++) {
        const size_t size = sph_grid_workspace(dim, N);
        unsigned char *const work = (unsigned char *)cloud_memory(size, 1), *const copy = (unsigned char *)cloud_memory(size, 1);
        memset(work, 0x55, size);
        memset(copy, 0x55, size);
        CHECK(sph_grid_workspace(dim, 0) == 0);
        CHECK(sph_grid_workspace(dim, -1) == 0);
        CHECK(sph_grid_workspace(dim, 1) > 0);

        CHECK(sph_grid_build(0, p, reach, work, size, &g) == SPH_ERROR_DIM);
        CHECK(sph_grid_build(4, p, reach, work, size, &g) == SPH_ERROR_DIM);
        CHECK(sph_grid_build(-1, p, reach, work, size, &g) == SPH_ERROR_DIM);
        CHECK(sph_grid_build(dim, p, reach, 0, size, &g) == SPH_ERROR_NULL);
        CHECK(sph_grid_build(dim, p, reach, work, size, 0) == SPH_ERROR_NULL);
        for (i = 0; i < dim; i++) { /* each coordinate that is read: missing, NaN, infinite; each length of the box */
            sph_real *const coordinate = i == 0 ? x : i == 1 ? y : z;
            q = p;
            if (i == 0) q.x = 0;
            if (i == 1) q.y = 0;
            if (i == 2) q.z = 0;
            CHECK(sph_grid_build(dim, q, reach, work, size, &g) == SPH_ERROR_NULL);
            for (which = 0; which < 2; which++) {
                const sph_real kept = coordinate[N - 1];
                coordinate[N - 1] = which ? SPH_R(INFINITY) : SPH_R(NAN);
                CHECK(sph_grid_build(dim, p, reach, work, size, &g) == SPH_ERROR_POSITION);
                coordinate[N - 1] = kept;
            }
            for (which = 0; which < 4; which++) {
                const sph_real lengths[] = {SPH_R(-1), SPH_R(NAN), SPH_R(INFINITY), SPH_R(0.59)};
                q = sph_points_periodic(p, i == 0 ? lengths[which] : SPH_R(0), i == 1 ? lengths[which] : SPH_R(0), i == 2 ? lengths[which] : SPH_R(0));
                CHECK(sph_grid_build(dim, q, reach, work, size, &g) == SPH_ERROR_BOX);
            }
        }
        q = p;
        q.n = 0;
        CHECK(sph_grid_build(dim, q, reach, work, size, &g) == SPH_ERROR_COUNT);
        q.n = -1;
        CHECK(sph_grid_build(dim, q, reach, work, size, &g) == SPH_ERROR_COUNT);
        q = p;
        q.stride = 0;
        CHECK(sph_grid_build(dim, q, reach, work, size, &g) == SPH_ERROR_COUNT);
        for (i = 0; i < 4; i++) CHECK(sph_grid_build(dim, p, wrong[i], work, size, &g) == SPH_ERROR_H);
        CHECK(sph_grid_build(dim, p, reach, work, size - 1, &g) == SPH_ERROR_CAPACITY);
        CHECK(sph_grid_build(dim, p, reach, work, 0, &g) == SPH_ERROR_CAPACITY);
        CHECK(memcmp(work, copy, size) == 0);
        CHECK(memcmp(&g, &untouched, sizeof g) == 0);
        /* what is not read may be missing */
        CHECK(sph_grid_build(dim, sph_points_separate(N, x, dim > 1 ? y : 0, dim > 2 ? z : 0), reach, work, size, &g) == 0);
        memset(&g, 0x55, sizeof g);
        free(work);
        free(copy);
    }
}

static void test_grid_lists(void)
{
    enum { N = 7 };
    sph_real x[N], y[N], z[N], R[N];
    const sph_real reach = SPH_R(0.3);
    const sph_scalars same = sph_scalars_same(&reach), each = sph_scalars_array(R);
    sph_scalars none = same;
    sph_index start[N + 2], index[N * N], untouched[N * N];
    sph_points p, q;
    int64_t pairs = -5;
    int i, dim, which, flags;
    memset(start, 0x55, sizeof start);
    memset(index, 0x55, sizeof index);
    none.p = 0;
    for (i = 0; i < N; i++) {
        x[i] = SPH_R(0.1 * i);
        y[i] = SPH_R(0.05 * i);
        z[i] = SPH_R(0.02 * i);
        R[i] = reach;
    }
    for (dim = 1; dim <= 3; dim++) {
        const size_t size = sph_grid_workspace(dim, N);
        void *const work = cloud_memory(size, 1);
        sph_grid g;
        p = sph_points_separate(N, x, dim > 1 ? y : 0, dim > 2 ? z : 0);
        CHECK(sph_grid_build(dim, p, reach, work, size, &g) == 0);
/* counting and filling */
#define BOTH(dim, grid, targets, criterion, target, source, flags, s, error) \
    do { \
        CHECK(sph_grid_lists(dim, grid, targets, criterion, target, source, flags, s, 0, 0, &pairs) == (error)); \
        CHECK(sph_grid_lists(dim, grid, targets, criterion, target, source, flags, s, index, N *N, &pairs) == (error)); \
    } while (0)
        for (flags = 0; flags <= SPH_LIST_FOREIGN; flags += SPH_LIST_FOREIGN) {
            BOTH(0, &g, p, SPH_GATHER, same, same, flags, start, SPH_ERROR_DIM);
            BOTH(4, &g, p, SPH_GATHER, same, same, flags, start, SPH_ERROR_DIM);
            BOTH(dim == 1 ? 2 : dim - 1, &g, sph_points_separate(N, x, y, z), SPH_GATHER, same, same, flags, start, SPH_ERROR_DIM); /* not the grid's */
            BOTH(dim, 0, p, SPH_GATHER, same, same, flags, start, SPH_ERROR_NULL);
            BOTH(dim, &g, p, SPH_GATHER, same, same, flags, 0, SPH_ERROR_NULL);
            BOTH(dim, &g, p, SPH_GATHER, none, same, flags, start, SPH_ERROR_NULL);
            BOTH(dim, &g, p, SPH_SCATTER, same, none, flags, start, SPH_ERROR_NULL);
            for (which = SPH_LARGER; which <= SPH_MEAN; which++) {
                BOTH(dim, &g, p, which, none, same, flags, start, SPH_ERROR_NULL);
                BOTH(dim, &g, p, which, same, none, flags, start, SPH_ERROR_NULL);
            }
            BOTH(dim, &g, p, -1, same, same, flags, start, SPH_ERROR_VALUE);
            BOTH(dim, &g, p, SPH_MEAN + 1, same, same, flags, start, SPH_ERROR_VALUE);
            BOTH(dim, &g, p, SPH_GATHER, same, same, flags | 16, start, SPH_ERROR_VALUE);
            BOTH(dim, &g, p, SPH_GATHER, same, same, -1, start, SPH_ERROR_VALUE);
            CHECK(sph_grid_lists(dim, &g, p, SPH_GATHER, same, same, flags, start, index, -1, &pairs) == SPH_ERROR_VALUE);
            CHECK(sph_grid_lists(dim, &g, p, SPH_GATHER, same, same, flags, start, 0, 0, 0) == SPH_ERROR_NULL);
            CHECK(sph_grid_lists(dim, &g, p, SPH_GATHER, same, same, flags, start, index, N * N, 0) == SPH_ERROR_NULL);
            for (i = 0; i < dim; i++) {
                sph_real *const coordinate = i == 0 ? x : i == 1 ? y : z;
                q = p;
                if (i == 0) q.x = 0;
                if (i == 1) q.y = 0;
                if (i == 2) q.z = 0;
                BOTH(dim, &g, q, SPH_GATHER, same, same, flags, start, SPH_ERROR_NULL);
                for (which = 0; which < 2; which++) {
                    const sph_real kept = coordinate[N - 1];
                    coordinate[N - 1] = which ? SPH_R(INFINITY) : SPH_R(NAN);
                    BOTH(dim, &g, p, SPH_GATHER, same, same, flags, start, SPH_ERROR_POSITION);
                    coordinate[N - 1] = kept;
                }
            }
            q = p;
            q.n = 0;
            BOTH(dim, &g, q, SPH_GATHER, same, same, flags, start, SPH_ERROR_COUNT);
            q.n = -1;
            BOTH(dim, &g, q, SPH_GATHER, same, same, flags, start, SPH_ERROR_COUNT);
            q = p;
            q.stride = 0;
            BOTH(dim, &g, q, SPH_GATHER, same, same, flags, start, SPH_ERROR_COUNT);
            for (which = 0; which < 5; which++) {
                const sph_real radii[] = {SPH_R(0), SPH_R(-1), SPH_R(NAN), SPH_R(INFINITY), SPH_R(9.7)}; /* 32 times the reach is the most */
                R[N - 1] = radii[which];
                BOTH(dim, &g, p, SPH_GATHER, each, same, flags, start, which < 4 ? SPH_ERROR_H : SPH_ERROR_RADIUS);
                BOTH(dim, &g, p, SPH_SCATTER, same, each, flags, start, which < 4 ? SPH_ERROR_H : SPH_ERROR_RADIUS);
                R[N - 1] = reach;
            }
        }
        BOTH(dim, &g, p, SPH_GATHER, same, same, SPH_LIST_FOREIGN | SPH_LIST_SELF, start, SPH_ERROR_VALUE);
        BOTH(dim, &g, p, SPH_GATHER, same, same, SPH_LIST_FOREIGN | SPH_LIST_HALF, start, SPH_ERROR_VALUE);
        for (i = 0; i < dim; i++) { /* a radius beyond half the box, though the reach is not */
            const sph_real radius = SPH_R(0.51), one = SPH_R(1);
            sph_grid boxed;
            void *const other = cloud_memory(size, 1);
            CHECK(sph_grid_build(dim, sph_points_periodic(p, i == 0 ? one : SPH_R(0), i == 1 ? one : SPH_R(0), i == 2 ? one : SPH_R(0)), reach, other, size,
                                 &boxed) == 0);
            BOTH(dim, &boxed, p, SPH_GATHER, sph_scalars_same(&radius), same, 0, start, SPH_ERROR_BOX);
            BOTH(dim, &boxed, p, SPH_LARGER, same, sph_scalars_same(&radius), 0, start, SPH_ERROR_BOX);
            free(other);
        }
        q = p;
        q.n = N + 1; /* a target that is no source */
        BOTH(dim, &g, q, SPH_GATHER, same, same, 0, start, SPH_ERROR_RANGE);
#undef BOTH
        free(work);
    }
    CHECK(pairs == -5);
    memset(untouched, 0x55, sizeof untouched);
    CHECK(memcmp(start, untouched, sizeof start) == 0);
    CHECK(memcmp(index, untouched, sizeof index) == 0);
}

static void test_rebuild_due(void)
{
    enum { N = 7 };
    sph_real x[N], y[N], z[N];
    const sph_real skin = SPH_R(0.1);
    sph_points p, q;
    int i, dim, which;
    for (i = 0; i < N; i++) {
        x[i] = SPH_R(0.1 * i);
        y[i] = SPH_R(0.05 * i);
        z[i] = SPH_R(0.02 * i);
    }
    p = sph_points_separate(N, x, y, z);
    CHECK(sph_rebuild_due(0, p, p, skin) == SPH_ERROR_DIM);
    CHECK(sph_rebuild_due(4, p, p, skin) == SPH_ERROR_DIM);
    for (dim = 1; dim <= 3; dim++) {
        CHECK(sph_rebuild_due(dim, sph_points_separate(N, x, dim > 1 ? y : 0, dim > 2 ? z : 0), p, skin) == 0);
        for (i = 0; i < dim; i++) {
            q = p;
            if (i == 0) q.x = 0;
            if (i == 1) q.y = 0;
            if (i == 2) q.z = 0;
            CHECK(sph_rebuild_due(dim, q, p, skin) == SPH_ERROR_NULL);
            CHECK(sph_rebuild_due(dim, p, q, skin) == SPH_ERROR_NULL);
            for (which = 0; which < 3; which++) {
                const sph_real lengths[] = {SPH_R(-1), SPH_R(NAN), SPH_R(INFINITY)};
                q = sph_points_periodic(p, i == 0 ? lengths[which] : SPH_R(0), i == 1 ? lengths[which] : SPH_R(0), i == 2 ? lengths[which] : SPH_R(0));
                CHECK(sph_rebuild_due(dim, q, p, skin) == SPH_ERROR_BOX);
            }
        }
        q = p;
        q.n = N - 1;
        CHECK(sph_rebuild_due(dim, q, p, skin) == SPH_ERROR_COUNT);
        q.n = 0;
        CHECK(sph_rebuild_due(dim, q, q, skin) == SPH_ERROR_COUNT);
        q = p;
        q.stride = 0;
        CHECK(sph_rebuild_due(dim, q, p, skin) == SPH_ERROR_COUNT);
        CHECK(sph_rebuild_due(dim, p, q, skin) == SPH_ERROR_COUNT);
        CHECK(sph_rebuild_due(dim, p, p, SPH_R(-1)) == SPH_ERROR_VALUE);
        CHECK(sph_rebuild_due(dim, p, p, SPH_R(NAN)) == SPH_ERROR_VALUE);
    }
}

static void test_permute(void)
{
    enum { N = 4 };
    const sph_index order[N] = {2, 0, 3, 1}, too_large[N] = {2, 0, 3, N}, negative[N] = {2, 0, 3, -1};
    const sph_real in[N] = {SPH_R(1), SPH_R(2), SPH_R(3), SPH_R(4)};
    sph_real out[N] = {SPH_R(-1), SPH_R(-1), SPH_R(-1), SPH_R(-1)};
    sph_index inverse[N] = {-1, -1, -1, -1};
    CHECK(sph_permute(N, 0, in, 1, out) == SPH_ERROR_NULL);
    CHECK(sph_permute(N, order, 0, 1, out) == SPH_ERROR_NULL);
    CHECK(sph_permute(N, order, in, 1, 0) == SPH_ERROR_NULL);
    CHECK(sph_permute(-1, order, in, 1, out) == SPH_ERROR_COUNT);
    CHECK(sph_permute(0, order, in, 1, out) == SPH_ERROR_COUNT);
    CHECK(sph_permute(N, order, in, 0, out) == SPH_ERROR_COUNT);
    CHECK(sph_permute(N, too_large, in, 1, out) == SPH_ERROR_LIST);
    CHECK(sph_permute(N, negative, in, 1, out) == SPH_ERROR_LIST);
    CHECK(sph_permute_inverse(0, order, inverse) == SPH_ERROR_COUNT);
    CHECK(sph_permute_inverse(N, too_large, inverse) == SPH_ERROR_LIST);
    CHECK(sph_permute_inverse(N, negative, inverse) == SPH_ERROR_LIST);
    CHECK(sph_permute_inverse(N, 0, inverse) == SPH_ERROR_NULL);
    CHECK(sph_permute_inverse(N, order, 0) == SPH_ERROR_NULL);
    CHECK(sph_permute_inverse(-1, order, inverse) == SPH_ERROR_COUNT);
    CHECK(out[0] == SPH_R(-1) && out[1] == SPH_R(-1) && out[2] == SPH_R(-1) && out[3] == SPH_R(-1));
    CHECK(inverse[0] == -1 && inverse[1] == -1 && inverse[2] == -1 && inverse[3] == -1);
}

int main(void)
{
    test_faults();
    test_legal();
    test_degenerate();
    test_bim();
    test_grid_build();
    test_grid_lists();
    test_rebuild_due();
    test_permute();
    return check_report("test_bad_input");
}
