/* SPDX-License-Identifier: MIT
 *
 * icspm.h - the setting of the ICSPM paper (Korzilius, Schilders & Anthonissen 2017), shared by its drivers: particles on [0, 1], the function
 * f = x^2 + cos(pi x), the three approximations of f'' and the boundary value problem (5.18) solved with them.
 */
#ifndef ICSPM_H
#define ICSPM_H

#include <math.h>

#include "../common/banded.h"
#include "../common/figure.h"
#include "../common/host.h"

#define ICSPM_KERNEL SPH_WENDLAND_C4_1D

static inline double icspm_f(double x) { return x * x + cos(MATH_PI * x); }
static inline double icspm_df(double x) { return 2 * x - MATH_PI * sin(MATH_PI * x); }
static inline double icspm_d2f(double x) { return 2 - MATH_PI * MATH_PI * cos(MATH_PI * x); }

enum { CSPM, BIM, ICSPM, METHODS };
static const char *const icspm_method_name[METHODS] = {"CSPM", "BIM", "ICSPM"};

/* N = 10 * 2^(k-1) + 1 for k = 1 ... 8 */
enum { LEVELS = 8, LARGEST = 1281 };
static inline int icspm_size(int level) { return 10 * (1 << level) + 1; }

/* h / max volume: 2 for CSPM and ICSPM, k^2 for BIM */
static inline double icspm_c(int method, int level)
{
    return method == BIM ? (level + 1.0) * (level + 1.0) : 2.0;
}

/* Particles on a line in ascending order, with their neighbours. */
typedef struct line {
    int n;
    double h;
    double *x, *V, *f, *value, *row, *diagonal, *factor, *conditioning, *band;
    unsigned char *status;
    search near;
    size_t row_capacity, band_capacity;
} line;

static inline void line_open(line *s, int largest)
{
    const size_t n = (size_t)largest;
    double **const arrays[] = {&s->x, &s->V, &s->f, &s->value, &s->diagonal, &s->factor, &s->conditioning};
    size_t a;
    memset(s, 0, sizeof *s);
    for (a = 0; a < sizeof arrays / sizeof *arrays; a++) *arrays[a] = (double *)need(NULL, n, sizeof(double));
    s->status = (unsigned char *)need(NULL, n, 1);
}

static inline void line_close(line *s)
{
    void *const arrays[] = {s->x,      s->V,   s->f,   s->value, s->diagonal, s->factor, s->conditioning,
                            s->status, s->row, s->band};
    size_t a;
    for (a = 0; a < sizeof arrays / sizeof *arrays; a++) free(arrays[a]);
    search_close(&s->near);
}

static inline sph_points line_points(const line *s) { return sph_points_separate(s->n, s->x, NULL, NULL); }
static inline sph_cloud line_cloud(const line *s)
{
    return sph_cloud_of(line_points(s), s->near.found.list, sph_scalars_same(&s->h), sph_scalars_array(s->V));
}

/* Neighbours for the smoothing length h, once x and n are set. */
static inline void line_neighbours(line *s, double h)
{
    const double radius = h * sph_kernel_support_ratio(ICSPM_KERNEL);
    size_t pairs;
    s->h = h;
    search_all(&s->near, 1, line_points(s), sph_scalars_same(&radius), SPH_GATHER);
    pairs = (size_t)s->near.found.pairs;
    if (pairs <= s->row_capacity) return;
    s->row = (double *)need(s->row, pairs, sizeof *s->row);
    s->row_capacity = pairs;
}

/* Volumes from the midpoints between neighbours; the end particles own the half interval. Returns the largest. */
static inline double line_volumes(line *s)
{
    double largest = 0;
    int i;
    for (i = 0; i < s->n; i++) {
        const double left = i > 0 ? 0.5 * (s->x[i] - s->x[i - 1]) : 0,
                     right = i + 1 < s->n ? 0.5 * (s->x[i + 1] - s->x[i]) : 0;
        s->V[i] = left + right;
        if (s->V[i] > largest) largest = s->V[i];
    }
    return largest;
}

static inline void line_sample(line *s, double (*f)(double))
{
    int i;
    for (i = 0; i < s->n; i++) s->f[i] = f(s->x[i]);
}

/* x_i = i / (n - 1); h = c dx */
static inline void line_uniform(line *s, int n, double c)
{
    int i;
    s->n = n;
    for (i = 0; i < n; i++) s->x[i] = (double)i / (n - 1);
    line_volumes(s);
    line_sample(s, icspm_f);
    line_neighbours(s, c / (n - 1));
}

/* f'' by a method into s->value, status into s->status, kappa (ICSPM) into s->conditioning; returns how many particles are not ok. */
static inline int line_second_derivative(line *s, int method)
{
    const sph_cloud cloud = line_cloud(s);
    const sph_scalars f = sph_scalars_array(s->f);
    const sph_derivatives_options defaults = {0};
    sph_derivatives_out out = {0};
    sph_index bad;
    out.hxx = s->value;
    out.conditioning = s->conditioning;
    out.status = s->status;
    if (method == CSPM) bad = sph_derivatives_cspm(ICSPM_KERNEL, 1, cloud, f, defaults, out);
    else if (method == ICSPM) bad = sph_derivatives_icspm(ICSPM_KERNEL, 1, cloud, f, defaults, out);
    else
        bad = sph_second_derivative_bim(ICSPM_KERNEL, cloud, f, 0, s->n - 1,
                                        sph_scalar_out_array(s->value, s->status));
    return (int)expect(bad);
}

/* max |value - exact| over the particles where the method answers: all of them, or for BIM all but the ends */
static inline double line_error(const line *s, double (*exact)(double))
{
    double worst = 0;
    int i;
    for (i = 0; i < s->n; i++) {
        const double e = fabs(s->value[i] - exact(s->x[i]));
        if (s->status[i] != SPH_NOT_AVAILABLE && !(e <= worst)) worst = e;
    }
    return worst;
}

static inline double line_direct_error(line *s, int method)
{
    line_second_derivative(s, method);
    return line_error(s, icspm_d2f);
}

/* stencil rows of the second derivative into s->row, s->diagonal, s->factor */
static inline void line_rows(line *s, int method)
{
    const sph_cloud cloud = line_cloud(s);
    const sph_index *const start = s->near.found.list.start;
    sph_rows_out out = {0};
    int i, p;
    out.row = s->row;
    out.diagonal = s->diagonal;
    out.factor = s->factor;
    if (method == CSPM) expect(sph_derivatives_rows_cspm(ICSPM_KERNEL, 1, cloud, sph_jet_laplacian(1), out));
    else if (method == ICSPM)
        expect(sph_derivatives_rows_icspm(ICSPM_KERNEL, 1, cloud, sph_jet_laplacian(1), out));
    else {
        out.diagonal = out.factor = NULL;
        expect(sph_second_derivative_rows_bim(ICSPM_KERNEL, cloud, 0, s->n - 1, out));
        for (i = 0; i < s->n; i++) {
            s->factor[i] = 1;
            s->diagonal[i] = 0;
            for (p = start[i]; p < start[i + 1]; p++) s->diagonal[i] -= s->row[p];
        }
    }
}

/* Solves u'' = f'' with u given at both ends, rows of the method inside; u into s->value. Returns 0, or 1 if the matrix is singular (s->value is NaN then). */
static inline int line_solve(line *s, int method, double (*f)(double), double (*d2f)(double))
{
    const sph_index *const start = s->near.found.list.start, *const index = s->near.found.list.index;
    banded A;
    size_t size;
    int i, p, below = 0, above = 0;
    line_rows(s, method);
    for (i = 1; i < s->n - 1; i++)
        for (p = start[i]; p < start[i + 1]; p++) {
            const int j = index[p];
            if (i - j > below) below = i - j;
            if (j - i > above) above = j - i;
        }
    size = banded_size(s->n, below, above);
    if (size > s->band_capacity) {
        s->band_capacity = size;
        s->band = (double *)need(s->band, size, sizeof *s->band);
    }
    A = banded_make(s->band, s->n, below, above);
    banded_zero(&A);
    for (i = 0; i < s->n; i++) {
        s->status[i] = SPH_OK;
        if (i == 0 || i == s->n - 1) {
            banded_add(&A, i, i, 1);
            s->value[i] = f(s->x[i]);
            continue;
        }
        banded_add(&A, i, i, s->diagonal[i]);
        for (p = start[i]; p < start[i + 1]; p++) banded_add(&A, i, index[p], s->row[p]);
        s->value[i] = s->factor[i] * d2f(s->x[i]);
    }
    if (banded_factor_solve(&A, s->value) == 0) return 0;
    for (i = 0; i < s->n; i++) s->value[i] = HUGE_VAL;
    return 1;
}

/* max |u - f| of the boundary value problem (5.18) */
static inline double line_bvp_error(line *s, int method)
{
    line_solve(s, method, icspm_f, icspm_d2f);
    return line_error(s, icspm_f);
}

/* order of convergence between two sizes that differ by a factor of two: (log(coarse / fine)) / log 2 */
static inline double icspm_order(double coarse, double fine) { return log(coarse / fine) / log(2.0); }

#endif
