/* SPDX-License-Identifier: MIT
 *
 * measure.h - what the atlas measures of an operator.
 */
#ifndef ATLAS_MEASURE_H
#define ATLAS_MEASURE_H

#include "../common/progress.h"
#include "../common/statistics.h"
#include "eigenvalues.h"
#include "families.h"
#include "operators.h"

typedef struct op {
    const char *id, *function;
    int family, list;
    const char *formula, *source, *note;
    sph_index (*call)(sph_kernel k, int dim, const sample *s, double *const *in, double *const *out);
} op;

/* Spacings 1/16, 1/32, ... 1/512: the waves are some 2 long. */
/* SHOWN: the level of tables, 1/64 */
enum { LEVELS = 6, INPUTS = 3, OUTPUTS = 6, SHOWN = 2, WAVES = 24, DISTANCES = 40, JITTERS = 7, STATUSES = 8, BOTH = 2, CONJUGATES = 8, FIGURES = 12 };
static inline double level_spacing(int level) { return ldexp(1.0, -4 - level); }
static const double atlas_jitter[JITTERS] = {0.0, 0.01, 0.03, 0.1, 0.2, 0.3, 0.45};
static const double atlas_default_jitter = 0.2;

typedef struct config {
    int dim;
    sph_kernel k;
    double h_dx;
} config;

/* Of one operator, at one configuration. Errors are root mean squares over a region, in units of the size of the
   answer. */
typedef struct errors {
    double rms[SAMPLE_KINDS][REGIONS][LEVELS], worst[SAMPLE_KINDS][REGIONS][LEVELS];
    double status[SAMPLE_KINDS][REGIONS][STATUSES]; /* shares of particles */
    double worst_conditioning[SAMPLE_KINDS];   /* of the particle whose error is the largest, at the level of tables */
    double worst_rank[SAMPLE_KINDS];           /* share of particles whose conditioning is lower */
    double worst_error[SAMPLE_KINDS];
} errors;

/* A number that is measured on each kind of cloud, of an operator that is not linear. */
typedef struct figure {
    const char *name;
    double value[SAMPLE_KINDS];
} figure;

/* Of one operator, at a standard configuration of each dimension. */
typedef struct portrait {
    int exact, exact_lattice;                  /* degrees: -1 nothing, 0 constants, 1 linear ... */
    double at_distance[BOTH][DISTANCES];       /* error against the distance from wall and surface, in half spacings */
    double at_jitter[JITTERS];
    complex_pair transfer[BOTH][WAVES];        /* along an axis and a diagonal, k dx = pi (w + 1) / WAVES */
    double monotone_inside, monotone_all;      /* share of rows whose other weights have one sign */
    double row_sum;                            /* the largest, in units of the sum of absolute values */
    double symmetry;                           /* |V_i L_ij - V_j L_ji| / |V_i L_ij|, root mean squares */
    double momentum, angular, energy;          /* sum V L f, sum V x cross L f, and max sum V f L f, relative */
    int conjugates;                            /* numbers of the operators that are conjugate to it */
    int conjugate[CONJUGATES];
    double rotation;                           /* what a rotation of everything changes, relative */
    double re_most, re_least, im_most, condition; /* eigenvalues times dx^2 */
    complex_pair *eigenvalue;
    int eigenvalues;
    figure figures[FIGURES];
    int figure_count;
} portrait;

/* ---- calls ---- */

typedef struct arrays {
    double *in[INPUTS], *out[OUTPUTS], *other[OUTPUTS];
} arrays;
static inline arrays arrays_of(sph_index n)
{
    arrays a;
    for (int c = 0; c < INPUTS; c++) a.in[c] = numbers(n);
    for (int c = 0; c < OUTPUTS; c++) a.out[c] = numbers(n), a.other[c] = numbers(n);
    return a;
}
static inline void arrays_free(arrays *a)
{
    for (int c = 0; c < INPUTS; c++) free(a->in[c]);
    for (int c = 0; c < OUTPUTS; c++) free(a->out[c]), free(a->other[c]);
}

/* out = operator in, with statuses and conditioning in the sample. */
static inline void apply(const op *o, sample *s, double *const *in, double *const *out)
{
    for (sph_index i = s->cloud.first; i < s->cloud.last; i++) {
        s->status[i] = SPH_OK;
        s->conditioning[i] = 1.0;
        for (int c = 0; c < OUTPUTS; c++) out[c][i] = 0.0;
    }
    if (o->call(s->k, s->dim, s, in, out) >= 0) return;
    fprintf(stderr, "\natlas: %s: %s\n", o->id, answer_text(-1));
    exit(2);
}
static inline int answered(const sample *s, sph_index i)
{
    const int t = s->status[i];
    return t == SPH_OK || t == SPH_ILL_CONDITIONED || t == SPH_FELL_BACK || t == SPH_LIST_TOO_SHORT;
}
static inline void position(const sample *s, sph_index i, double *x)
{
    for (int a = 0; a < 3; a++) x[a] = a < s->dim ? s->x[a][i] : 0.0;
}

/* The mobility that the operators div(m grad u) see: 1, or a wave about it. */
static inline field_jet mobility_at(int dim, int varied, const double *x)
{
    wave_field f = field_waves(dim, 3);
    for (int w = 0; w < 3; w++) f.size[w] *= varied ? 0.15 : 0.0;
    field_jet j = field_at(&f, x);
    j.value += 1.0;
    return j;
}

/* The error of each particle for these fields, relative to `scale`; NaN where there is no answer. */
static inline void errors_of(const op *o, sample *s, arrays *a, const wave_field *f, int varied, double scale, double *error)
{
    const int inputs = family_inputs(o->family, s->dim), outputs = family_outputs(o->family, s->dim);
    for (sph_index i = 0; i < s->n; i++) {
        double x[3];
        position(s, i, x);
        for (int c = 0; c < inputs; c++) a->in[c][i] = field_at(&f[c], x).value;
        s->mobility[i] = mobility_at(s->dim, varied, x).value;
        for (int c = 0; c < 3; c++) x[c] = s->wall_point[c][i];
        const field_jet at_wall = field_at(&f[0], x);
        s->wall_value[i] = at_wall.value;
        for (int c = 0; c < 3; c++) s->wall_slope[c][i] = at_wall.d[c];
    }
    apply(o, s, a->in, a->out);
    for (sph_index i = s->cloud.first; i < s->cloud.last; i++) {
        double x[3], want[OUTPUTS], sum = 0.0;
        field_jet j[INPUTS];
        if (!answered(s, i)) {
            error[i] = (double)NAN;
            continue;
        }
        position(s, i, x);
        for (int c = 0; c < inputs; c++) j[c] = field_at(&f[c], x);
        const field_jet m = mobility_at(s->dim, varied, x);
        family_answer(o->family, s->dim, j, &m, want);
        for (int c = 0; c < outputs; c++) sum += (a->out[c][i] - want[c]) * (a->out[c][i] - want[c]);
        error[i] = sqrt(sum) / scale;
    }
}

/* ---- errors against the spacing ---- */

static inline double region_rms(const sample *s, const double *error, int region, double *worst)
{
    double sum = 0.0, most = 0.0;
    long count = 0;
    for (sph_index i = s->cloud.first; i < s->cloud.last; i++) {
        if ((region >= 0 && s->region[i] != region) || isnan(error[i])) continue;
        sum += error[i] * error[i];
        most = fmax(most, error[i]);
        count++;
    }
    if (worst) *worst = most;
    return count ? sqrt(sum / (double)count) : (double)NAN;
}

/* Of a sample that is zoomed to a level. */
static inline void measure_errors(const op *o, sample *s, int level, errors *e)
{
    if (o->family >= WITH_ERRORS) { /* none is measured */
        for (int region = 0; region < REGIONS; region++) e->rms[s->kind][region][level] = e->worst[s->kind][region][level] = (double)NAN;
        return;
    }
    arrays a = arrays_of(s->n);
    double *const error = numbers(s->n);
    wave_field f[3];
    family_waves(o->family, s->dim, f);
    errors_of(o, s, &a, f, o->family == ELLIPTIC, family_scale(o->family), error);
    for (int region = 0; region < REGIONS; region++) e->rms[s->kind][region][level] = region_rms(s, error, region, &e->worst[s->kind][region][level]);
    if (level == SHOWN) {
        sph_index worst = 0;
        long lower = 0, count[REGIONS] = {0};
        for (sph_index i = 0; i < s->targets; i++) count[s->region[i]]++;
        for (sph_index i = 0; i < s->targets; i++) {
            e->status[s->kind][s->region[i]][s->status[i]] += 1.0 / (double)count[s->region[i]];
            if (isnan(error[worst]) || error[i] > error[worst]) worst = i;
        }
        for (sph_index i = 0; i < s->targets; i++) lower += s->conditioning[i] < s->conditioning[worst];
        e->worst_error[s->kind] = error[worst];
        e->worst_conditioning[s->kind] = s->conditioning[worst];
        e->worst_rank[s->kind] = (double)lower / (double)s->targets;
    }
    free(error);
    arrays_free(&a);
}

/* The order that the errors at the last spacings show: log2 of their ratio. Errors that are rounding alone: infinite. */
static inline double order_of(const double *rms)
{
    if (isnan(rms[0])) return (double)NAN;
    if (rms[0] < 1e-11) return HUGE_VAL;
    return log2(rms[LEVELS - 2] / rms[LEVELS - 1]);
}

/* ---- exactness ---- */

/* The highest degree such that all monomials up to it are exact, in a region (-1: everywhere). */
static inline int measure_degree(const op *o, sample *s, int region)
{
    arrays a = arrays_of(s->n);
    double *const error = numbers(s->n);
    int degree = -1, exact = 1;
    const double far_out = 0.5 * s->side;
    for (int d = 0; d <= (o->family == ADAPTIVE ? 0 : 3) && exact; d++) { /* densities are positive */
        for (int x = d; x >= 0 && exact; x--)
            for (int y = d - x; y >= 0 && exact; y--) {
                const int z = d - x - y;
                if (z > 0 && s->dim < 3) continue;
                for (int c = 0; c < family_inputs(o->family, s->dim) && exact; c++) {
                    wave_field f[3];
                    double worst;
                    for (int q = 0; q < 3; q++) {
                        f[q] = field_monomial(0, 0, 0);
                        if (q != c) f[q].waves = 1; /* of the size 0 */
                    }
                    f[c] = field_monomial(x, y, z);
                    /* what rounding costs grows with the values that are multiplied */
                    errors_of(o, s, &a, f, 0, 1.0 + pow(far_out, d), error);
                    region_rms(s, error, region, &worst);
                    exact = worst < 1e-8;
                }
            }
        if (exact) degree = d;
    }
    free(error);
    arrays_free(&a);
    return degree;
}

/* ---- against the distance from a side, and against jitter ---- */

static inline void measure_distance(const op *o, sample *s, portrait *p)
{
    arrays a = arrays_of(s->n);
    double *const error = numbers(s->n), middle = 0.5 * (s->side - 1.0), reach = sample_reach(s);
    wave_field f[3];
    family_waves(o->family, s->dim, f);
    s->cloud = sph_cloud_range(s->cloud, 0, s->n);
    errors_of(o, s, &a, f, o->family == ELLIPTIC, family_scale(o->family), error);
    for (int side = 0; side < BOTH; side++)
        for (int d = 0; d < DISTANCES; d++) {
            double sum = 0.0;
            long count = 0;
            for (sph_index i = 0; i < s->n; i++) {
                int along = 1;
                for (int b = 1; b < s->dim; b++) along &= s->unit[b][i] > middle - 0.5 * reach && s->unit[b][i] < middle + 0.5 * reach;
                const double away = side ? s->side - 0.5 - s->unit[0][i] : s->unit[0][i];
                if (!along || isnan(error[i]) || (int)floor(2.0 * away + 1e-9) != d || away > 2.0 * reach + 1.0) continue;
                sum += error[i] * error[i];
                count++;
            }
            p->at_distance[side][d] = count ? sqrt(sum / (double)count) : (double)NAN;
        }
    s->cloud = sph_cloud_range(s->cloud, 0, s->targets);
    free(error);
    arrays_free(&a);
}
static inline void measure_jitter(const op *o, sample *s, double *at)
{
    arrays a = arrays_of(s->n);
    double *const error = numbers(s->n);
    wave_field f[3];
    family_waves(o->family, s->dim, f);
    errors_of(o, s, &a, f, o->family == ELLIPTIC, family_scale(o->family), error);
    *at = region_rms(s, error, REGION_INSIDE, NULL);
    free(error);
    arrays_free(&a);
}

/* ---- the response to a wave ---- */

/* For exp(i k x) the factor that a derivative should have: 1, i k, -k^2; the response is what is found divided by it. */
static inline complex_pair family_response(int which, double k, double re, double im)
{
    const double power = which == PRESSURE ? -k : k;
    switch (family(which).powers) {
    case 0: return pair_of(re, im);
    case 1: return pair_of(im / power, -re / power);
    default: return pair_of(-re / (k * k), -im / (k * k));
    }
}
static inline void measure_transfer(const op *o, sample *s, portrait *p)
{
    arrays a = arrays_of(s->n);
    const sph_index middle = sample_middle(s);
    for (sph_index i = 0; i < s->n; i++) s->mobility[i] = 1.0;
    s->cloud = sph_cloud_range(s->cloud, middle, middle + 1);
    for (int diagonal = 0; diagonal < BOTH; diagonal++)
        for (int w = 0; w < WAVES; w++) {
            const double k = acos(-1.0) * (w + 1) / WAVES, share = diagonal ? 1.0 / sqrt(2.0) : 1.0;
            const double along[3] = {share, diagonal ? share : 0.0, 0.0}, across[3] = {diagonal ? -share : 0.0, share, 0.0};
            double found[2] = {0.0, 0.0};
            for (int part = 0; part < 2; part++) {
                for (sph_index i = 0; i < s->n; i++) {
                    double t = 0.0;
                    for (int b = 0; b < s->dim; b++) t += k * along[b] * (s->x[b][i] - s->x[b][middle]);
                    const double wave = part ? sin(t) : cos(t);
                    const double *const way = o->family == DIVERGENCE ? along : across; /* a vector along k, or across it */
                    if (!family(o->family).in) a.in[0][i] = wave;
                    else
                        for (int b = 0; b < s->dim; b++) a.in[b][i] = way[b] * wave;
                }
                apply(o, s, a.in, a.out);
                const double c = along[0], d = along[1];
                switch (family(o->family).out) {
                case 1:
                    for (int b = 0; b < s->dim; b++) found[part] += (o->family == VISCOSITY ? across : along)[b] * a.out[b][middle];
                    break;
                case 2: found[part] = a.out[s->dim == 2 ? 0 : 2][middle]; break;
                case 3: found[part] = c * c * a.out[0][middle] + 2.0 * c * d * a.out[1][middle] + d * d * a.out[2][middle]; break;
                default: found[part] = a.out[0][middle];
                }
            }
            p->transfer[diagonal][w] = family_response(o->family, k, found[0], found[1]);
        }
    s->cloud = sph_cloud_range(s->cloud, 0, s->targets);
    arrays_free(&a);
}

/* ---- what the matrix of an operator is like: all its weights, by giving 1 to one particle after another ---- */

/* The walls of boundary integrals give nothing: what is left is linear in the particles' values. */
static inline void walls_zero(sample *s)
{
    memset(s->wall_value, 0, (size_t)s->n * sizeof(double));
    for (int c = 0; c < 3; c++) memset(s->wall_slope[c], 0, (size_t)s->n * sizeof(double));
}
/* 1 if nothing is cut off from the support of a particle */
static inline int uncut(const sample *s, sph_index i)
{
    const double reach = sample_reach(s);
    int inner = 1;
    for (int b = 0; b < s->dim; b++) inner &= s->unit[b][i] >= reach && s->unit[b][i] <= s->side - 1.0 - reach;
    return inner;
}
static inline double relative(double a, double b) { return b > 0.0 ? a / b : 0.0; }

static inline void measure_matrix(const op *o, sample *s, portrait *p)
{
    arrays a = arrays_of(s->n);
    const sph_index n = s->n;
    walls_zero(s);
    double *const matrix = (double *)need_zeros((size_t)(n * n), sizeof *matrix), *const error = numbers(n);
    const int scalar = family_inputs(o->family, s->dim) == 1 && family_outputs(o->family, s->dim) == 1;
    for (sph_index i = 0; i < n; i++) s->mobility[i] = 1.0;
    if (scalar) {
        long inside = 0, one_sign = 0, one_sign_inside = 0;
        double odd = 0.0, size = 0.0;
        for (sph_index j = 0; j < n; j++) {
            a.in[0][j] = 1.0;
            apply(o, s, a.in, a.out);
            for (sph_index i = 0; i < n; i++) matrix[i * n + j] = a.out[0][i];
            a.in[0][j] = 0.0;
        }
        for (sph_index i = 0; i < n; i++) {
            double least = 0.0, most = 0.0, sum = 0.0, all = 0.0;
            for (sph_index j = 0; j < n; j++) {
                const double w = matrix[i * n + j];
                sum += w;
                all += fabs(w);
                if (j == i) continue;
                least = fmin(least, w);
                most = fmax(most, w);
                const double d = s->volume[i] * w - s->volume[j] * matrix[j * n + i];
                odd += d * d;
                size += s->volume[i] * w * s->volume[i] * w;
            }
            const int ok = least >= -1e-12 * most || most <= -1e-12 * least, in = uncut(s, i);
            one_sign += ok;
            one_sign_inside += ok && in;
            inside += in;
            if (o->family != VALUE) p->row_sum = fmax(p->row_sum, relative(fabs(sum), all));
        }
        p->monotone_all = (double)one_sign / (double)n;
        p->monotone_inside = inside ? (double)one_sign_inside / (double)inside : (double)NAN;
        p->symmetry = sqrt(relative(odd, size));
        if (o->family == LAPLACIAN || o->family == ELLIPTIC) { /* with values given on all particles of the outermost layers */
            int m = 0;
            sph_index *const keep = (sph_index *)need_zeros((size_t)n, sizeof *keep);
            for (sph_index i = 0; i < n; i++) {
                int inner = 1;
                for (int b = 0; b < s->dim; b++) inner &= s->unit[b][i] > 0.75 * s->h_dx && s->unit[b][i] < s->side - 1.0 - 0.75 * s->h_dx;
                if (inner) keep[m++] = i;
            }
            double *const block = (double *)need_zeros((size_t)m * (size_t)m, sizeof *block);
            for (int r = 0; r < m; r++)
                for (int c = 0; c < m; c++) block[r * m + c] = matrix[keep[r] * n + keep[c]];
            p->eigenvalue = (complex_pair *)need_zeros((size_t)m, sizeof *p->eigenvalue);
            p->eigenvalues = eigenvalues(m, block, p->eigenvalue) ? m : 0;
            double least = HUGE_VAL, most = 0.0;
            p->re_most = -HUGE_VAL;
            p->re_least = HUGE_VAL;
            for (int r = 0; r < p->eigenvalues; r++) {
                const double size_of = pair_size(p->eigenvalue[r]);
                p->re_most = fmax(p->re_most, p->eigenvalue[r].re);
                p->re_least = fmin(p->re_least, p->eigenvalue[r].re);
                p->im_most = fmax(p->im_most, fabs(p->eigenvalue[r].im));
                least = fmin(least, size_of);
                most = fmax(most, size_of);
            }
            p->condition = most / least;
            free(block);
            free(keep);
        }
    }
    /* sums over random fields: the worst of some */
    pcg32 g;
    pcg32_seed(&g, 4711, 3);
    const int inputs = family_inputs(o->family, s->dim), outputs = family_outputs(o->family, s->dim), vector = family(o->family).out == 1;
    p->energy = -HUGE_VAL;
    for (int draw = 0; draw < 8; draw++) {
        double sum[OUTPUTS] = {0.0}, all = 0.0, turn[3] = {0.0, 0.0, 0.0}, turn_all = 0.0, energy = 0.0, energy_all = 0.0;
        for (int c = 0; c < inputs; c++)
            for (sph_index i = 0; i < n; i++) a.in[c][i] = pcg32_uniform(&g) - (o->family == PRESSURE ? 0.0 : 0.5);
        apply(o, s, a.in, a.out);
        for (sph_index i = 0; i < n; i++) {
            double x[3], y[3] = {0.0, 0.0, 0.0};
            position(s, i, x);
            for (int c = 0; c < outputs; c++) {
                sum[c] += s->volume[i] * a.out[c][i];
                all += s->volume[i] * fabs(a.out[c][i]);
                if (c < inputs) {
                    energy += s->volume[i] * a.in[c][i] * a.out[c][i];
                    energy_all += s->volume[i] * fabs(a.in[c][i] * a.out[c][i]);
                }
                if (vector) y[c] = a.out[c][i];
            }
            for (int c = 0; c < 3; c++) {
                const int d = (c + 1) % 3, e = (c + 2) % 3;
                turn[c] += s->volume[i] * (x[d] * y[e] - x[e] * y[d]);
                turn_all += s->volume[i] * fabs(x[d] * y[e]);
            }
        }
        for (int c = 0; c < outputs; c++) p->momentum = fmax(p->momentum, relative(fabs(sum[c]), all));
        for (int c = 0; c < 3; c++) p->angular = fmax(p->angular, relative(fabs(turn[c]), turn_all));
        p->energy = fmax(p->energy, relative(energy, energy_all));
    }
    free(matrix);
    free(error);
    arrays_free(&a);
}

/* ---- which gradient and divergence are conjugate: sum V f div A = -sum V A . grad f, for random f and A ---- */

static inline void measure_conjugates(const op *o, int gradient, int divergence, sample *s, portrait *of_gradient, portrait *of_divergence)
{
    arrays a = arrays_of(s->n), b = arrays_of(s->n);
    double sum = 0.0, size = 0.0;
    pcg32 g;
    pcg32_seed(&g, 99, 5);
    for (sph_index i = 0; i < s->n; i++) {
        a.in[0][i] = pcg32_uniform(&g) - 0.5;
        for (int c = 0; c < s->dim; c++) b.in[c][i] = pcg32_uniform(&g) - 0.5;
    }
    apply(&o[gradient], s, a.in, a.out);
    apply(&o[divergence], s, b.in, b.out);
    for (sph_index i = 0; i < s->n; i++) {
        double along = 0.0;
        for (int c = 0; c < s->dim; c++) along += (o[gradient].family == PRESSURE ? -1.0 : 1.0) * b.in[c][i] * a.out[c][i];
        sum += s->volume[i] * (along + a.in[0][i] * b.out[0][i]);
        size += s->volume[i] * (fabs(along) + fabs(a.in[0][i] * b.out[0][i]));
    }
    if (fabs(sum) < 1e-12 * size && of_gradient->conjugates < CONJUGATES && of_divergence->conjugates < CONJUGATES) {
        of_gradient->conjugate[of_gradient->conjugates++] = divergence;
        of_divergence->conjugate[of_divergence->conjugates++] = gradient;
    }
    arrays_free(&a);
    arrays_free(&b);
}

/* ---- what a rotation changes ---- */

static inline void turn(double c, double s, double *x, double *y)
{
    const double a = *x;
    *x = c * a - s * *y;
    *y = s * a + c * *y;
}
/* Positions, vectors and tensors turn by half a radian in the plane of x and y; the lists stay. */
static const double atlas_angle = 0.5;
static inline void sample_turn(sample *s)
{
    for (sph_index i = 0; i < s->n; i++) turn(cos(atlas_angle), sin(atlas_angle), &s->x[0][i], &s->x[1][i]), turn(cos(atlas_angle), sin(atlas_angle), &s->wall_gradient[0][i], &s->wall_gradient[1][i]);
    s->cloud = sph_cloud_range(s->cloud, 0, s->n);
    sample_corrections(s);
    s->cloud = sph_cloud_range(s->cloud, 0, s->targets);
}
/* A sample, and the same turned. */
static inline void measure_rotation(const op *o, sample *s, sample *turned, portrait *p)
{
    arrays a = arrays_of(s->n), b = arrays_of(s->n);
    const double c = cos(atlas_angle), t = sin(atlas_angle);
    const int inputs = family_inputs(o->family, s->dim), outputs = family_outputs(o->family, s->dim), out = family(o->family).out;
    double worst = 0.0, size = 0.0;
    pcg32 g;
    pcg32_seed(&g, 31, 9);
    walls_zero(s);
    walls_zero(turned);
    for (sph_index i = 0; i < s->n; i++) {
        s->mobility[i] = turned->mobility[i] = 1.0;
        for (int q = 0; q < inputs; q++) a.in[q][i] = b.in[q][i] = pcg32_uniform(&g);
        if (inputs > 1) turn(c, t, &b.in[0][i], &b.in[1][i]);
    }
    apply(o, s, a.in, a.out);
    apply(o, turned, b.in, b.out);
    for (sph_index i = 0; i < s->targets; i++) {
        if (out == 1 || (out == 2 && s->dim == 3)) turn(c, t, &a.out[0][i], &a.out[1][i]);
        if (out == 3) { /* R H R^T: columns, then rows */
            double xx = a.out[0][i], xy = a.out[1][i], yx = xy, yy = a.out[2][i];
            turn(c, t, &xx, &yx);
            turn(c, t, &xy, &yy);
            turn(c, t, &xx, &xy);
            turn(c, t, &yx, &yy);
            a.out[0][i] = xx, a.out[1][i] = xy, a.out[2][i] = yy;
            if (s->dim > 2) turn(c, t, &a.out[3][i], &a.out[4][i]);
        }
        for (int q = 0; q < outputs; q++) {
            worst = fmax(worst, fabs(a.out[q][i] - b.out[q][i]));
            size = fmax(size, fabs(b.out[q][i]));
        }
    }
    p->rotation = relative(worst, size);
    arrays_free(&a);
    arrays_free(&b);
}

/* All of these for all operators, at one configuration, as far as their family allows. */
static inline void measure_portraits(const op *o, int count, const config *c, int targets, portrait *p, size_t stride)
{
    const sample_wish jitter = {SAMPLE_JITTER, targets, 0, atlas_default_jitter, 5}, regular = {SAMPLE_LATTICE, targets, 0, 0.0, 1};
    sample jittered = sample_make(c->k, c->dim, c->h_dx, jitter), turned = sample_make(c->k, c->dim, c->h_dx, jitter);
    sample lattice = sample_make(c->k, c->dim, c->h_dx, regular);
#define PORTRAIT(q) ((portrait *)(void *)((char *)(void *)p + (size_t)(q)*stride))
    sample_zoom(&jittered, 1.0);
    sample_zoom(&turned, 1.0);
    sample_turn(&turned);
    sample_zoom(&lattice, 1.0);
    for (int q = 0; q < count; q++) {
        if (o[q].family != GRAVITY || c->dim == 3) measure_rotation(&o[q], &jittered, &turned, PORTRAIT(q));
        if (o[q].family >= WITH_ERRORS) continue;
        PORTRAIT(q)->exact = measure_degree(&o[q], &jittered, -1);
        PORTRAIT(q)->exact_lattice = measure_degree(&o[q], &lattice, REGION_INSIDE);
        if (o[q].family < LINEAR) measure_transfer(&o[q], &lattice, PORTRAIT(q));
    }
    sample_zoom(&lattice, level_spacing(SHOWN - 1));
    for (int q = 0; q < count; q++)
        if (o[q].family < WITH_ERRORS) measure_distance(&o[q], &lattice, PORTRAIT(q));
    sample_free(&jittered);
    sample_free(&turned);
    sample_free(&lattice);
    for (int j = 0; j < JITTERS; j++) {
        const sample_wish by = {SAMPLE_JITTER, targets, 0, atlas_jitter[j], 11};
        sample s = sample_make(c->k, c->dim, c->h_dx, by);
        sample_zoom(&s, level_spacing(SHOWN - 1));
        for (int q = 0; q < count; q++)
            if (o[q].family < WITH_ERRORS) measure_jitter(&o[q], &s, &PORTRAIT(q)->at_jitter[j]);
        sample_free(&s);
    }
    if (c->dim == 2) {
        const sample_wish all = {SAMPLE_JITTER, 0, (int)(2.0 * (double)sph_kernel_support_ratio(c->k) * c->h_dx) + 7, atlas_default_jitter, 7};
        sample few = sample_make(c->k, c->dim, c->h_dx, all);
        sample_zoom(&few, 1.0);
        for (int q = 0; q < count; q++)
            if (o[q].family < LINEAR) measure_matrix(&o[q], &few, PORTRAIT(q));
        for (int q = 0; q < count; q++)
            for (int d = 0; d < count; d++)
                if ((o[q].family == GRADIENT || o[q].family == PRESSURE) && o[d].family == DIVERGENCE) measure_conjugates(o, q, d, &few, PORTRAIT(q), PORTRAIT(d));
        sample_free(&few);
    }
#undef PORTRAIT
}

#endif
