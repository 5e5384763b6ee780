/* SPDX-License-Identifier: MIT */
/*
 * derivatives.c - fuzz target: corrected gradients, second derivatives and stencil rows on small clouds of any shape, against the same equations set up and solved in long double. How far they may be apart
 * follows from the equations: |A^-1| (|dA| |x| + |db|) for entries that are off by rounding; clouds whose equations leave nothing of the numbers are only asked for finite outputs and zeros where the status says so.
 * M-SPH and its siblings: rows applied are the operator, and linear fields have no divergence.
 */
#include "fuzz.h"

#include "../../sph_ops.h"

enum { MOST = 24, UNKNOWNS = 9 };
enum { CSPM, ICSPM, WLS };

typedef struct cloud {
    int dim;
    sph_kernel k;
    sph_index n;
    sph_real x[3][MOST], V[MOST], m[MOST], f[MOST], h[MOST];
    sph_index start[MOST + 1], index[MOST * MOST];
} cloud;

static sph_cloud all(const cloud *c)
{
    sph_list l;
    l.start = c->start;
    l.index = c->index;
    return sph_cloud_of(sph_points_separate(c->n, c->x[0], c->x[1], c->x[2]), l, sph_scalars_array(c->h),
                        sph_scalars_array(c->V));
}

static void make(cloud *c, fuzz_input *in)
{
    const int how = (int)fuzz_byte(in), lattice = how & 1, same_h = how & 2, flat = how & 4, all = how & 8;
    double a[10];
    sph_index i, j;
    int t;
    c->dim = 1 + fuzz_below(in, 3);
    c->k = (sph_kernel)fuzz_below(in, SPH_KERNEL_COUNT);
    c->n = (sph_index)(1 + fuzz_below(in, MOST));
    for (t = 0; t < 10; t++) a[t] = ((double)fuzz_byte(in) - 128.0) / 32.0;
    for (i = 0; i < c->n; i++) {
        const double h = 0.4 + 1.2 * fuzz_unit(in);
        for (t = 0; t < 3; t++) c->x[t][i] = SPH_R(t >= c->dim ? 0.0 : flat && t > 0 ? 0.25 * (double)c->x[0][i] : lattice ? 0.25 * fuzz_below(in, 9) : fuzz_tame(in));
        c->V[i] = SPH_R(0.1 + fuzz_unit(in));
        c->m[i] = SPH_R(0.1 + fuzz_unit(in));
        c->h[i] = same_h && i > 0 ? c->h[0] : SPH_R(h);
        { /* a quadratic, and with it everything between a constant and one */
            const double x = (double)c->x[0][i], y = (double)c->x[1][i], z = (double)c->x[2][i];
            c->f[i] = SPH_R(a[0] + a[1] * x + a[2] * y + a[3] * z + a[4] * x * x + a[5] * x * y + a[6] * y * y + a[7] * x * z + a[8] * y * z + a[9] * z * z);
        }
    }
    c->start[0] = 0;
    for (i = 0; i < c->n; i++) {
        sph_index at = c->start[i];
        for (j = 0; j < c->n; j++) {
            double r2 = 0;
            for (t = 0; t < c->dim; t++) r2 += pow((double)c->x[t][i] - (double)c->x[t][j], 2);
            if (j != i && (all || sqrt(r2) < 1.01 * (double)sph_kernel_support_ratio(c->k) * (double)c->h[i])) c->index[at++] = j;
        }
        c->start[i + 1] = at;
    }
}

/* ---- the reference ---- */

/* n equations for as many unknowns, and how far each coefficient may be off: in multiples of `unit` */
typedef struct equations {
    int n;
    long double a[UNKNOWNS][UNKNOWNS], a_size[UNKNOWNS][UNKNOWNS], b[UNKNOWNS], b_size[UNKNOWNS];
} equations;

/* Inverse by Gauss and Jordan with full pivoting by rows scaled by the diagonal's size. Returns 0 if singular. */
static int invert(const equations *e, long double inverse[UNKNOWNS][UNKNOWNS])
{
    long double w[UNKNOWNS][2 * UNKNOWNS];
    int i, j, c;
    for (i = 0; i < e->n; i++)
        for (j = 0; j < 2 * e->n; j++) w[i][j] = j < e->n ? e->a[i][j] : (long double)(j - e->n == i);
    for (c = 0; c < e->n; c++) {
        int best = c;
        for (i = c + 1; i < e->n; i++)
            if (fabsl(w[i][c]) > fabsl(w[best][c])) best = i;
        if (!(fabsl(w[best][c]) > 0.0L)) return 0;
        for (j = 0; j < 2 * e->n; j++) {
            const long double t = w[c][j];
            w[c][j] = w[best][j];
            w[best][j] = t;
        }
        for (i = 0; i < e->n; i++) {
            const long double factor = w[i][c] / w[c][c];
            for (j = 0; i != c && j < 2 * e->n; j++) w[i][j] -= factor * w[c][j];
        }
    }
    for (i = 0; i < e->n; i++)
        for (j = 0; j < e->n; j++) inverse[i][j] = w[i][e->n + j] / w[i][i];
    return 1;
}
/* sum of |A^-1| |A| by rows, the largest: how much rounding is amplified at most. Does not depend on the scaling of the columns' tests. */
static long double amplification(const equations *e, long double inverse[UNKNOWNS][UNKNOWNS])
{
    long double most = 0.0L;
    int i, j, l;
    for (i = 0; i < e->n; i++) {
        long double sum = 0.0L;
        for (j = 0; j < e->n; j++)
            for (l = 0; l < e->n; l++) sum += fabsl(inverse[i][l]) * e->a_size[l][j];
        most = sum > most ? sum : most;
    }
    return most;
}

/* x_a or x_a x_b of e, in the order of the unknowns: gradient, then xx, xy, yy, xz, yz, zz */
static long double monomial(int dim, int which, const long double *e)
{
    static const int first[] = {0, 0, 1, 0, 1, 2}, second[] = {0, 1, 1, 2, 2, 2};
    return which < dim ? e[which] : e[first[which - dim]] * e[second[which - dim]];
}
static int second_derivatives(int dim) { return dim * (dim + 1) / 2; }

static sph_test_weights weights(const cloud *c, int method, long double q, sph_real V)
{
    return method == WLS ? sph_test_weights_wls(c->k, c->dim, SPH_R(q), V) : sph_test_weights_cspm(c->k, c->dim, SPH_R(q), V);
}
/* How many units of round-off a weight may be off: its own size, what a q that is off makes of it (near the edge of the support much more than its size), and the rounding of a polynomial whose terms cancel */
static sph_test_weights doubts(const cloud *c, int method, long double q, sph_real V)
{
    const long double step = SPH_SINGLE ? 1e-4L : 1e-7L;
    const sph_test_weights w = weights(c, method, q, V), a = weights(c, method, q * (1.0L - step), V), b = weights(c, method, q * (1.0L + step), V),
                           middle = weights(c, method, 0.5L * (long double)sph_kernel_support_ratio(c->k), V);
    sph_test_weights d;
    d.g = SPH_R(fabs((double)w.g) + fabs((double)b.g - (double)a.g) / (double)step + 0.1 * fabs((double)middle.g));
    d.w = SPH_R(fabs((double)w.w) + fabs((double)b.w - (double)a.w) / (double)step + 0.1 * fabs((double)middle.w));
    return d;
}

/* The equations of sph_ops.h, "corrected first and second derivatives": tests g e and w e e, unknowns h grad f and h^2 hess (halved on the diagonal). Only the weights g, w are the header's. */
static void set_up(const cloud *c, int method, sph_index i, int first, int last, equations *e)
{
    sph_index p;
    int s, t;
    memset(e, 0, sizeof *e);
    e->n = last - first;
    for (p = c->start[i]; p < c->start[i + 1]; p++) {
        const sph_index j = c->index[p];
        long double d[3], r = 0.0L;
        sph_test_weights w, doubt;
        for (t = 0; t < 3; t++) {
            d[t] = ((long double)c->x[t][j] - (long double)c->x[t][i]) / (long double)c->h[i];
            r += d[t] * d[t];
        }
        w = weights(c, method, sqrtl(r), c->V[j]);
        doubt = doubts(c, method, sqrtl(r), c->V[j]);
        for (s = first; s < last; s++) {
            const long double test = (long double)(s < c->dim ? w.g : w.w) * monomial(c->dim, s, d);
            const long double test_size = (long double)(s < c->dim ? doubt.g : doubt.w) * fabsl(monomial(c->dim, s, d)), df = (long double)c->f[j] - (long double)c->f[i];
            for (t = first; t < last; t++) {
                e->a[s - first][t - first] += test * monomial(c->dim, t, d);
                e->a_size[s - first][t - first] += test_size * fabsl(monomial(c->dim, t, d));
            }
            e->b[s - first] += test * df;
            e->b_size[s - first] += test_size * (fabsl((long double)c->f[j]) + fabsl((long double)c->f[i]));
        }
    }
}

/* solution and how far off the header's may be, times the unit round-off; returns the amplification, or -1 without a solution */
static long double solve(const equations *e, long double *x, long double *off)
{
    long double inverse[UNKNOWNS][UNKNOWNS], error[UNKNOWNS], most = 0.0L;
    int i, j;
    if (!invert(e, inverse)) return -1.0L;
    for (i = 0; i < e->n; i++) {
        x[i] = 0.0L;
        for (j = 0; j < e->n; j++) x[i] += inverse[i][j] * e->b[j];
    }
    for (i = 0; i < e->n; i++) {
        error[i] = e->b_size[i];
        for (j = 0; j < e->n; j++) error[i] += e->a_size[i][j] * fabsl(x[j]);
    }
    for (i = 0; i < e->n; i++) {
        off[i] = 0.0L;
        for (j = 0; j < e->n; j++) off[i] += fabsl(inverse[i][j]) * error[j];
        most = off[i] > most ? off[i] : most;
    }
    for (i = 0; i < e->n; i++) off[i] = most; /* elimination spreads errors over all unknowns */
    return amplification(e, inverse);
}

/* ---- comparisons ---- */

/* gradient, xx, xy, yy, xz, yz, zz of particle i */
typedef struct outputs {
    sph_real value[9][MOST], laplacian[MOST], conditioning[MOST];
    unsigned char status[MOST];
} outputs;

static sph_derivatives_out out_of(outputs *o, int dim)
{
    sph_derivatives_out out;
    memset(&out, 0, sizeof out);
    out.gx = o->value[0];
    out.gy = dim > 1 ? o->value[1] : NULL;
    out.gz = dim > 2 ? o->value[2] : NULL;
    out.hxx = o->value[dim];
    out.hxy = dim > 1 ? o->value[dim + 1] : NULL;
    out.hyy = dim > 1 ? o->value[dim + 2] : NULL;
    out.hxz = dim > 2 ? o->value[dim + 3] : NULL;
    out.hyz = dim > 2 ? o->value[dim + 4] : NULL;
    out.hzz = dim > 2 ? o->value[dim + 5] : NULL;
    out.laplacian = o->laplacian;
    out.conditioning = o->conditioning;
    out.status = o->status;
    return out;
}

static const long double ROUNDINGS = 400.0L; /* sums of 24 terms, weights with some of their own, elimination with growth */

/* The derivatives of particle i by the method; *unknown is how they enter the equations. Returns 0 where rounding may have spoilt them, else how far off they may be, relative to all of them in units of `off`. */
static int reference(const cloud *c, int method, sph_index i, long double *value, long double *off)
{
    const int dim = c->dim, all = dim + second_derivatives(dim);
    const long double h = (long double)c->h[i];
    long double x[UNKNOWNS], error[UNKNOWNS], cost;
    equations e, K, M;
    int t;
    if (method == WLS) {
        set_up(c, method, i, 0, all, &e);
        cost = solve(&e, x, error);
        if (cost < 0.0L) return 0;
    } else {
        long double g[UNKNOWNS], g_off[UNKNOWNS], m[UNKNOWNS], m_off[UNKNOWNS], cost_K, cost_M;
        int s;
        set_up(c, method, i, 0, all, &e);
        set_up(c, method, i, 0, dim, &K);
        set_up(c, method, i, dim, all, &M);
        cost_K = solve(&K, g, g_off);
        if (cost_K < 0.0L) return 0;
        if (method == CSPM) { /* the gradient as if there were no second derivatives, and these given the gradient */
            for (s = 0; s < M.n; s++)
                for (t = 0; t < dim; t++) {
                    M.b[s] -= e.a[dim + s][t] * g[t];
                    M.b_size[s] += e.a_size[dim + s][t] * (fabsl(g[t]) + g_off[t]);
                }
        }
        cost_M = solve(&M, m, m_off);
        if (cost_M < 0.0L) return 0;
        cost = cost_K * cost_M;
        if (method == CSPM)
            for (t = 0; t < all; t++) {
                x[t] = t < dim ? g[t] : m[t - dim];
                error[t] = t < dim ? g_off[t] : m_off[t - dim] * cost_K;
            }
        else { /* the header eliminates the gradient first: rounding passes through K and M, too */
            const long double whole = solve(&e, x, error);
            if (whole < 0.0L) return 0;
            for (t = 0; t < all; t++) error[t] *= cost;
            cost *= whole;
        }
    }
    for (t = 0; t < all; t++) {
        const int square = t == dim || t == dim + 2 || t == dim + 5; /* xx, yy, zz: half of the derivative */
        const long double back = t < dim ? 1.0L / h : (square ? 2.0L : 1.0L) / (h * h);
        value[t] = x[t] * back;
        off[t] = ROUNDINGS * (long double)SPH_EPSILON * error[t] * back;
    }
    return cost * (long double)SPH_EPSILON < 1e-6L;
}

/* Kernels with lobes of the other sign may have negative diagonals, which the scaling takes for singular. */
static int is_ordinary(sph_kernel k) { return k != SPH_SUPER_GAUSSIAN && k != SPH_LIU_QUARTIC; }

static int is_zero(sph_real x) { return !(x > SPH_R(0)) && !(x < SPH_R(0)); }

static void check_derivatives(const cloud *c, int method, const outputs *o, sph_index failed)
{
    const int all = c->dim + second_derivatives(c->dim);
    sph_index i, count = 0;
    int t;
    for (i = 0; i < c->n; i++) {
        long double want[UNKNOWNS], off[UNKNOWNS];
        const int good = reference(c, method, i, want, off), state = o->status[i];
        FUZZ_REQUIRE(state == SPH_OK || state == SPH_TOO_FEW || state == SPH_SINGULAR || state == SPH_NOT_FINITE);
        FUZZ_REQUIRE(isfinite(o->conditioning[i]) && isfinite(o->laplacian[i]));
        count += state != SPH_OK;
        if (good && is_ordinary(c->k)) FUZZ_REQUIRE(state == SPH_OK);
        for (t = 0; t < all; t++) {
            FUZZ_REQUIRE(isfinite(o->value[t][i]));
            if (state != SPH_OK) FUZZ_REQUIRE(is_zero(o->value[t][i]) && is_zero(o->laplacian[i]));
            else if (good) FUZZ_REQUIRE(fabsl((long double)o->value[t][i] - want[t]) <= off[t]);
        }
    }
    FUZZ_REQUIRE(count == failed);
}

/* rows applied to the field are factor times the Laplacian */
static void check_rows(const cloud *c, int method, const outputs *o)
{
    sph_real row[MOST * MOST], diagonal[MOST], factor[MOST];
    unsigned char status[MOST];
    sph_rows_out out = {0};
    sph_index i, p, answer;
    const sph_jet d = sph_jet_laplacian(c->dim);
    memset(&out, 0, sizeof out);
    out.row = row;
    out.diagonal = diagonal;
    out.factor = factor;
    out.status = status;
    if (method == CSPM) answer = sph_derivatives_rows_cspm(c->k, c->dim, all(c), d, out);
    else if (method == ICSPM) answer = sph_derivatives_rows_icspm(c->k, c->dim, all(c), d, out);
    else answer = sph_derivatives_rows_wls(c->k, c->dim, all(c), d, out);
    FUZZ_REQUIRE(answer >= 0);
    for (i = 0; i < c->n; i++) {
        long double want[UNKNOWNS], off[UNKNOWNS], sum = 0.0L, weights = 0.0L, largest = 0.0L, apart = 0.0L, allowed;
        const int good = reference(c, method, i, want, off);
        FUZZ_REQUIRE(isfinite(diagonal[i]) && isfinite(factor[i]));
        for (p = c->start[i]; p < c->start[i + 1]; p++) {
            FUZZ_REQUIRE(isfinite(row[p]));
            if (status[i] != SPH_OK) FUZZ_REQUIRE(is_zero(row[p]));
            sum += (long double)row[p] * ((long double)c->f[c->index[p]] - (long double)c->f[i]);
            weights += (long double)row[p];
            largest += fabsl((long double)row[p]) * (1.0L + fabsl((long double)c->f[c->index[p]]) + fabsl((long double)c->f[i]));
        }
        FUZZ_REQUIRE(fabsl((long double)diagonal[i] + weights) <= 64.0L * (long double)SPH_EPSILON * largest);
        if (!good || o->status[i] != SPH_OK) continue;
        if (is_ordinary(c->k)) FUZZ_REQUIRE(status[i] == SPH_OK);
        if (status[i] != SPH_OK) continue;
        for (p = c->dim; p < c->dim + second_derivatives(c->dim); p++)
            if (p == c->dim || p == c->dim + 2 || p == c->dim + 5) apart += off[p];
        allowed = fabsl((long double)factor[i]) * apart + 1e-9L * largest + (SPH_SINGLE ? 1e-2L * largest : 0.0L);
        FUZZ_REQUIRE(fabsl(sum - (long double)factor[i] * (long double)o->laplacian[i]) <= allowed);
    }
}

static void check_gradient(const cloud *c)
{
    sph_real g[3][MOST], w[3][MOST * MOST], conditioning[MOST];
    unsigned char status[MOST], row_status[MOST];
    sph_derivatives_out out;
    sph_gradient_rows_out rows = {0};
    sph_index i, p;
    int a;
    memset(&out, 0, sizeof out);
    memset(&rows, 0, sizeof rows);
    out.gx = g[0], out.gy = g[1], out.gz = g[2];
    out.conditioning = conditioning;
    out.status = status;
    rows.x = w[0], rows.y = w[1], rows.z = w[2];
    rows.status = row_status;
    FUZZ_REQUIRE(sph_gradient_cspm(c->k, c->dim, all(c), sph_scalars_array(c->f), out) >= 0);
    FUZZ_REQUIRE(sph_gradient_rows_cspm(c->k, c->dim, all(c), rows) >= 0);
    for (i = 0; i < c->n; i++) {
        equations K;
        long double x[UNKNOWNS], off[UNKNOWNS], cost;
        int good;
        set_up(c, CSPM, i, 0, c->dim, &K);
        cost = solve(&K, x, off);
        good = cost >= 0.0L && cost * (long double)SPH_EPSILON < 1e-6L;
        if (good && is_ordinary(c->k)) FUZZ_REQUIRE(status[i] == SPH_OK && row_status[i] == SPH_OK);
        for (a = 0; a < c->dim; a++) {
            long double sum = 0.0L, size = 0.0L;
            FUZZ_REQUIRE(isfinite(g[a][i]) && isfinite(conditioning[i]));
            for (p = c->start[i]; p < c->start[i + 1]; p++) {
                FUZZ_REQUIRE(isfinite(w[a][p]));
                sum += (long double)w[a][p] * ((long double)c->f[c->index[p]] - (long double)c->f[i]);
                size += fabsl((long double)w[a][p]) * (fabsl((long double)c->f[c->index[p]]) + fabsl((long double)c->f[i]));
            }
            if (status[i] != SPH_OK) FUZZ_REQUIRE(is_zero(g[a][i]));
            if (good && status[i] == SPH_OK) {
                const long double allowed = ROUNDINGS * (long double)SPH_EPSILON * off[a] / (long double)c->h[i];
                FUZZ_REQUIRE(fabsl((long double)g[a][i] - x[a] / (long double)c->h[i]) <= allowed);
                FUZZ_REQUIRE(fabsl(sum - x[a] / (long double)c->h[i]) <= allowed + ROUNDINGS * (long double)SPH_EPSILON * cost * size);
            }
        }
    }
}

/* ---- div(m grad u) ---- */

static void check_elliptic(const cloud *c, fuzz_input *in)
{
    typedef sph_index operator_of(sph_kernel, int, sph_cloud, sph_scalars, sph_elliptic_options, sph_scalars,
                                  sph_scalar_out);
    typedef sph_index rows_of(sph_kernel, int, sph_cloud, sph_scalars, sph_elliptic_options, sph_rows_out);
    static operator_of *const operators[] = {sph_elliptic_brookshaw, sph_elliptic_brookshaw_corrected, sph_elliptic_schwaiger, sph_elliptic_msph};
    static rows_of *const rows[] = {sph_elliptic_rows_brookshaw, sph_elliptic_rows_brookshaw_corrected, sph_elliptic_rows_schwaiger, sph_elliptic_rows_msph};
    const int which = fuzz_below(in, 4);
    sph_elliptic_options o = {0};
    sph_real out[MOST], applied[MOST], row[MOST * MOST], diagonal[MOST], u[MOST], conditioning[MOST];
    unsigned char status[MOST], row_status[MOST];
    const sph_scalars m = sph_scalars_array(c->m);
    sph_rows_out r = {0};
    sph_index answer, i, p;
    memset(&r, 0, sizeof r);
    r.row = row;
    r.diagonal = diagonal;
    r.conditioning = conditioning;
    r.status = row_status;
    o.gradient = fuzz_below(in, 5);
    o.mean = fuzz_below(in, 4);
    o.gamma_star = fuzz_below(in, 2);
    o.trace = fuzz_below(in, 2);
    o.potential = sph_scalars_array(c->f);
    for (i = 0; i < c->n; i++) u[i] = c->f[i];
    answer =
        operators[which](c->k, c->dim, all(c), m, o, sph_scalars_array(u), sph_scalar_out_array(out, status));
    FUZZ_REQUIRE(answer >= SPH_ERROR_PAIRS && answer <= c->n);
    FUZZ_REQUIRE(rows[which](c->k, c->dim, all(c), m, o, r) == answer || answer >= 0);
    if (answer < 0) return;
    for (p = 0; p < c->start[c->n]; p++) FUZZ_REQUIRE(isfinite(row[p]));
    FUZZ_REQUIRE(sph_rows_apply(all(c), row, sph_scalars_none(), sph_scalars_array(u), sph_scalar_out_array(applied, 0)) >= 0);
    for (i = 0; i < c->n; i++) {
        double size = 0;
        FUZZ_REQUIRE(isfinite(out[i]) && isfinite(diagonal[i]) && isfinite(conditioning[i]));
        for (p = c->start[i]; p < c->start[i + 1]; p++) size += fabs((double)row[p]) * (fabs((double)u[i]) + fabs((double)u[c->index[p]]));
        if (status[i] != row_status[i]) continue;
        if (status[i] == SPH_OK && fabs((double)conditioning[i]) > 1e-3) FUZZ_REQUIRE(fabs((double)out[i] - (double)applied[i]) <= (SPH_SINGLE ? 1e-2 : 1e-9) * (size + 1.0));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    const int what = fuzz_below(&in, 5);
    cloud c;
    memset(&c, 0, sizeof c);
    make(&c, &in);
    if (what == 3) check_gradient(&c);
    else if (what == 4) check_elliptic(&c, &in);
    else {
        const sph_derivatives_out none = {0};
        outputs o;
        sph_derivatives_out out = none;
        sph_index failed;
        memset(&o, 0, sizeof o);
        out = out_of(&o, c.dim);
        if (what == CSPM)
            failed = sph_derivatives_cspm(c.k, c.dim, all(&c), sph_scalars_array(c.f), (sph_derivatives_options){0}, out);
        else if (what == ICSPM)
            failed = sph_derivatives_icspm(c.k, c.dim, all(&c), sph_scalars_array(c.f), (sph_derivatives_options){0}, out);
        else failed = sph_derivatives_wls(c.k, c.dim, all(&c), sph_scalars_array(c.f), (sph_derivatives_options){0}, out);
        FUZZ_REQUIRE(failed >= 0);
        check_derivatives(&c, what, &o, failed);
        check_rows(&c, what, &o);
    }
    return 0;
}
