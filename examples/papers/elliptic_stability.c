/* SPDX-License-Identifier: MIT
 *
 * elliptic_stability.c - figures 5 and 6 of the paper on the elliptic operator and its sections 4.3 and 4.5: growth factors, signs of the transmissibilities, monotonicity.
 *
 *     cc -O2 -o elliptic_stability examples/papers/elliptic_stability.c -lm
 *     elliptic_stability -out DIR -figures DIR [-full]       (-h for help)
 *
 * The paper's figures are images: what is compared is what it says about them.
 */
#define ELLIPTIC_DIM(c) 2 /* of all clouds here */
#include "../common/options.h"
#include "../common/report.h"
#include "../common/statistics.h"
#include "elliptic.h"

static char setting[96];

/* ---------------------------------------------------------------- figure 5: growth factors */

enum { WAVES = 33 };

typedef struct growth {
    double inside, boundary;  /* largest |lambda| over particles with full support, and over the others */
    double least_re, most_im; /* with full support */
    double unstable;          /* share of the pairs of other particles and waves with |lambda| > 1 + 1e-6 */
} growth;

/* All particles, all waves of a WAVES x WAVES grid of |k_a| <= pi / dx; -k has the conjugate factor, so half of them do. Every so many points go to the figure. */
static growth growth_of(cloud *c, int scheme, int gradient, double tau, FILE *figure, const char *layout)
{
    growth s = {0, 0, HUGE_VAL, 0, 0};
    long count = 0, outer = 0, hit = 0;
    int i, a, b;
    cloud_rows(c, scheme, elliptic_with_gradient(gradient));
    for (i = 0; i < c->n; i++) {
        const int inside = cloud_inside(c, i);
        for (a = 0; a < WAVES; a++)
            for (b = WAVES / 2; b < WAVES; b++) {
                sph_vec k = {0, 0, 0};
                double re = 0, im = 0, size;
                k.x = (2.0 * a / (WAVES - 1) - 1) * MATH_PI / c->dx;
                k.y = (2.0 * b / (WAVES - 1) - 1) * MATH_PI / c->dx;
                expect(sph_rows_growth(2, sph_cloud_range(cloud_all(c), i, i + 1), c->row, tau, k, &re, &im));
                size = sqrt(re * re + im * im);
                if (inside) {
                    s.inside = fmax(s.inside, size);
                    s.least_re = fmin(s.least_re, re);
                    s.most_im = fmax(s.most_im, fabs(im));
                } else {
                    s.boundary = fmax(s.boundary, size);
                    outer++;
                    hit += size > 1 + 1e-6;
                }
                if (figure && count++ % 307 == 0)
                    fprintf(figure, "%s,%s,%s,%.6g,%.6g,%d\n", layout, elliptic_scheme_name[scheme],
                            elliptic_gradient_name[gradient], re, im, inside);
            }
    }
    s.unstable = (double)hit / (double)outer;
    return s;
}

static void figure5(report *r, cloud *c, const char *figures)
{
    static const double f[] = {1.2, 0.6};
    FILE *const out = figure_open(figures, "elliptic_fig5");
    int k, jittered, scheme, gradient;
    fprintf(out, "layout,scheme,gradient,re,im,inside\n");
    report_section(r, "Figure 5: growth factors on 21 x 21 nodes, tau = dx^2 / 4");
    for (k = 0; k < 2; k++)
        for (jittered = 0; jittered < 2; jittered++) {
            const char *const layout = jittered ? "perturbed" : "uniform";
            double worst = 0, unstable = 0, worst_im = 0;
            char text[160];
            pcg32 g;
            pcg32_seed(&g, 2020, 1);
            cloud_lattice(c, 2, 21, 2, 0.05);
            if (jittered) cloud_perturb(c, 0.1, &g);
            cloud_neighbours(c, f[k] * c->dx);
            for (scheme = SCHEME_CB; scheme <= SCHEME_M; scheme++)
                for (gradient = 0; gradient < GRADIENTS; gradient++) {
                    const growth s =
                        growth_of(c, scheme, gradient, 0.25 * c->dx * c->dx, k == 0 ? out : NULL, layout);
                    snprintf(setting, sizeof setting, "f = %g, %s, %s %s", f[k], layout,
                             elliptic_scheme_name[scheme], elliptic_gradient_name[gradient]);
                    if (k == 0)
                        report_range(r, "Figure 5", setting, "max |lambda|, interior", (double)NAN, s.inside,
                                     0, jittered ? 1 + 1e-6 : 1 + 1e-12);
                    else if (!jittered)
                        report_range(r, "Figure 5", setting, "max |lambda|, interior", (double)NAN, s.inside,
                                     0, 1 + 1e-12);
                    else report_info(r, "Figure 5", setting, "max |lambda|, interior", s.inside);
                    report_info(r, "Figure 5", setting, "least Re lambda, interior", s.least_re);
                    report_info(r, "Figure 5", setting, "max |Im lambda|, interior", s.most_im);
                    report_info(r, "Figure 5", setting, "max |lambda|, incomplete support", s.boundary);
                    report_info(r, "Figure 5", setting,
                                "share of waves and particles with |lambda| > 1, incomplete support",
                                s.unstable);
                    worst = fmax(worst, s.inside);
                    worst_im = fmax(worst_im, s.most_im);
                    unstable = fmax(unstable, s.boundary);
                }
            snprintf(setting, sizeof setting, "f = %g, %s", f[k], layout);
            snprintf(text, sizeof text,
                     "interior: max |lambda| %.6f, max |Im| %.2g; incomplete support: max |lambda| %.3f",
                     worst, worst_im, unstable);
            if (!jittered) {
                report_claim(r, "Section 4.3", setting, "lambda with full support",
                             "real, |lambda| <= 1 for all schemes", text, "to 1e-12",
                             worst <= 1 + 1e-12 && worst_im < 1e-12);
                report_claim_known(r, "Section 4.3", setting, "lambda of all particles",
                                   "|lambda| <= 1 for all schemes", text, "to 1e-12",
                                   fmax(worst, unstable) <= 1 + 1e-12, 0,
                                   "it holds where the support is full; boundary particles are excepted for "
                                   "perturbed particles only");
            } else
                report_claim_known(r, "Section 4.3", setting, "|lambda| <= 1",
                                   "almost everywhere, perhaps not at the boundary", text,
                                   "in the interior, to 1e-6", worst <= 1 + 1e-6, k == 0,
                                   "with four or so neighbours disorder makes rows of larger diagonal: a "
                                   "smaller tau is needed");
        }
    figure_close(out);
}

/* tau = 0.25, as printed, on the unit square of section 4.1 */
static void printed_tau(report *r, cloud *c)
{
    double inside;
    char text[64];
    cloud_lattice(c, 2, 21, 2, 0.05);
    cloud_neighbours(c, 1.2 * c->dx);
    inside = growth_of(c, SCHEME_M, 0, 0.25, NULL, "").inside;
    snprintf(text, sizeof text, "max |lambda| = %.4g, interior", inside);
    report_claim_known(r, "Section 4.3", "f = 1.2, uniform, M (15)", "tau", "0.25", text, "|lambda| <= 1", inside <= 1, 0,
                       "0.25 dx^2 is meant, or dx = 1");
}

/* ---------------------------------------------------------------- figure 6: |xi| in random neighbourhoods */

typedef struct xi_statistics {
    double mean, deviation, violated_92, violated_93; /* shares */
} xi_statistics;

/* n neighbours, uniformly distributed in the unit disc, around a particle in the middle: a list that the driver writes itself */
static xi_statistics xi_of(cloud *c, double h, int n, int draws, uint64_t stream)
{
    xi_statistics s = {0, 0, 0, 0};
    double xi = 0, least = 0, most = 0, square = 0;
    sph_elliptic_report out = {0};
    sph_cloud middle;
    pcg32 g;
    int draw, i;
    pcg32_seed(&g, 2020, stream);
    cloud_size(c, 2, n + 1);
    if (c->lists.capacity < n) {
        c->lists.start = (sph_index *)need(c->lists.start, (size_t)n + 2, sizeof *c->lists.start);
        c->lists.index = (sph_index *)need(c->lists.index, (size_t)n, sizeof *c->lists.index);
        c->lists.capacity = n;
        cloud_row_size(c);
    }
    c->lists.start[0] = 0;
    c->lists.start[1] = n;
    middle = cloud_all(c);
    middle.h = sph_scalars_same(&h);
    middle.last = 1;
    out.xi = &xi;
    out.sign_least = &least;
    out.sign_most = &most;
    for (draw = 0; draw < draws; draw++) {
        for (i = 1; i <= n; i++) {
            do {
                c->x[i] = 2 * pcg32_uniform(&g) - 1;
                c->y[i] = 2 * pcg32_uniform(&g) - 1;
            } while (c->x[i] * c->x[i] + c->y[i] * c->y[i] > 1);
            c->lists.index[i - 1] = i;
            c->V[i] = 1; /* cancels */
        }
        c->V[0] = 1;
        expect(sph_elliptic_diagnose(ELLIPTIC_KERNEL, 2, middle, (sph_elliptic_options){0}, out));
        s.mean += xi / draws;
        square += xi * xi / draws;
        s.violated_93 += least > 0 ? 0 : 1.0 / draws;
        s.violated_92 += least > 0 || most < 0 ? 0 : 1.0 / draws;
    }
    s.deviation = sqrt(fmax(square - s.mean * s.mean, 0) * draws / (draws - 1.0));
    return s;
}

static void figure6(report *r, cloud *c, const char *figures, int full)
{
    static const int some[] = {4, 5, 6, 8, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300, 400, 500};
    static const double hs[2] = {1, 0.5005};
    static const double factor[2] = {2.6, 5.5};
    enum { SOME = sizeof some / sizeof *some, MOST = 500 };
    FILE *const out = figure_open(figures, "elliptic_fig6");
    static double x[MOST], mean[MOST], deviation[MOST];
    char text[160];
    int a, k;
    fprintf(out, "h,n,mean,deviation,violated_92,violated_93\n");
    report_section(r, "Figure 6: |xi| of random neighbourhoods in the unit disc");
    for (a = 0; a < 2; a++) {
        const int count = full ? MOST - 3 : SOME;
        int used = 0, last_violated = 0;
        double coefficient = 0;
        for (k = 0; k < count; k++) {
            const int n = full ? k + 4 : some[k];
            const xi_statistics s = xi_of(c, hs[a], n, 50, (uint64_t)(n + 1000 * a));
            fprintf(out, "%g,%d,%.9g,%.9g,%g,%g\n", hs[a], n, s.mean, s.deviation, s.violated_92,
                    s.violated_93);
            if (s.violated_93 > 0) last_violated = n;
            if (n >= 20) {
                x[used] = log((double)n);
                mean[used] = log(s.mean);
                deviation[used++] = log(s.deviation);
                coefficient += s.mean * sqrt((double)n);
            }
            if (full && n != 4 && n != 10 && n != 30 && n != 50 && n != 100 && n != 200 && n != 500) continue;
            snprintf(setting, sizeof setting, "h = %g, %d neighbours, 50 draws", hs[a], n);
            report_info(r, "Figure 6", setting, "mean |xi|", s.mean);
            report_info(r, "Figure 6", setting, "deviation of |xi|", s.deviation);
            report_info(r, "Figure 6", setting, "share with (92) violated", s.violated_92);
            report_info(r, "Figure 6", setting, "share with (93) violated", s.violated_93);
        }
        snprintf(setting, sizeof setting, "h = %g, 20 to 500 neighbours", hs[a]);
        report_range(r, "Figure 6", setting, "exponent of mean |xi| in n (-1/2: N is a random sum)",
                     (double)NAN, statistics_slope(x, mean, used), -0.6, -0.4);
        report_range(r, "Figure 6", setting, "exponent of its deviation", (double)NAN,
                     statistics_slope(x, deviation, used), -0.7, -0.3);
        report_range(r, "Figure 6", setting, "mean of |xi| sqrt(n)", (double)NAN, coefficient / used,
                     0.9 * factor[a], 1.1 * factor[a]);
        snprintf(text, sizeof text, "no violation of (93) in 50 draws beyond n = %d", last_violated);
        report_claim(r, "Section 4.5", setting, "(92), (93)",
                     "fulfilled in statistical sense for many neighbours", text, "at most 300",
                     last_violated <= 300);
    }
    figure_close(out);
    if (full) /* the same with less noise */
        for (a = 0; a < 2; a++)
            for (k = 0; k < SOME; k++) {
                const xi_statistics s = xi_of(c, hs[a], some[k], 2000, (uint64_t)(some[k] + 1000 * a + 5000));
                snprintf(setting, sizeof setting, "h = %g, %d neighbours, 2000 draws", hs[a], some[k]);
                report_info(r, "Figure 6", setting, "mean |xi|", s.mean);
                report_info(r, "Figure 6", setting, "deviation of |xi|", s.deviation);
                report_info(r, "Figure 6", setting, "share with (93) violated", s.violated_93);
            }
}

/* ---------------------------------------------------------------- signs and monotone rows in section 5's layout */

typedef struct signs {
    double violated_92, violated_93, not_monotone, strict, failed; /* numbers of cell-centred particles */
    double least;         /* smallest 1 - xi . e of those that have rows */
    double disagree;      /* (93) holds, but the row is not that of an M-matrix */
    double heterogeneous; /* not monotone with a random m */
} signs;

/* means over the draws; one draw without jitter */
static signs signs_of(cloud *c, int N, double f, double jitter, int draws)
{
    signs s = {0, 0, 0, 0, 0, HUGE_VAL, 0, 0};
    double *const least = (double *)need(NULL, 2 * (size_t)(N * N + 4 * N), sizeof(double)), *const most =
                                                                                                 least +
                                                                                                 N * N +
                                                                                                 4 * N;
    unsigned char *const monotone = (unsigned char *)need(NULL, (size_t)(N * N + 4 * N), 1);
    const int dof = N * N;
    const double share = 1.0 / draws;
    pcg32 g;
    sph_index p;
    int draw, i;
    pcg32_seed(&g, 2020, 7);
    for (draw = 0; draw < draws; draw++) {
        sph_elliptic_report out = {0};
        sph_cloud inner;
        sph_index count;
        cloud_cells(c, N);
        if (jitter > 0) cloud_perturb(c, jitter, &g);
        cloud_neighbours(c, f * c->dx);
        out.sign_least = least;
        out.sign_most = most;
        expect(sph_elliptic_diagnose(ELLIPTIC_KERNEL, 2, cloud_all(c), (sph_elliptic_options){0}, out));
        cloud_rows(c, SCHEME_M, (sph_elliptic_options){0});
        inner = sph_cloud_range(cloud_all(c), 0, dof);
        count = sph_rows_monotone(inner, c->row, sph_scalars_array(c->diagonal), monotone);
        expect(count);
        s.not_monotone += share * count;
        for (i = 0; i < dof; i++) {
            double sum = 0;
            if (c->status[i] == SPH_TOO_FEW || c->status[i] == SPH_SINGULAR) {
                s.failed += share;
                continue;
            }
            for (p = c->lists.start[i]; p < c->lists.start[i + 1]; p++) sum += fabs(c->row[p]);
            s.least = fmin(s.least, least[i]);
            s.violated_93 += least[i] > 0 ? 0 : share;
            s.violated_92 += least[i] > 0 || most[i] < 0 ? 0 : share;
            s.strict += fabs(c->diagonal[i]) > sum * (1 + 1e-12) ? share : 0;
            s.disagree += least[i] > 0 && !monotone[i] ? share : 0;
        }
        for (i = 0; i < c->n; i++) c->m[i] = exp(4 * (2 * pcg32_uniform(&g) - 1)); /* a contrast of 3000 */
        cloud_rows(c, SCHEME_M, (sph_elliptic_options){0});
        count = sph_rows_monotone(inner, c->row, sph_scalars_array(c->diagonal), NULL);
        expect(count);
        s.heterogeneous += share * count;
    }
    free(least);
    free(monotone);
    return s;
}

static const double layouts[] = {0.5005, 0.6006, 1.001, 1.2012, 1.5, 2.002};
enum { LAYOUTS = sizeof layouts / sizeof *layouts };

static void monotonicity(report *r, cloud *c, int draws)
{
    static const double known[LAYOUTS] = {0, 0, 0, 4, 4, 156}; /* uniform */
    double disagree = 0, strict = 0, heterogeneous = 0, rows = 0;
    char text[160];
    int k, jittered;
    report_section(
        r, "Section 4.5: signs and monotone rows, 40 x 40 cells with boundary particles on their faces");
    for (jittered = 0; jittered < 2; jittered++)
        for (k = 0; k < LAYOUTS; k++) {
            const signs s = signs_of(c, 40, layouts[k], jittered ? 0.1 : 0, jittered ? draws : 1);
            snprintf(setting, sizeof setting, "f = %g, %s", layouts[k],
                     jittered ? "10 % perturbed (mean)" : "uniform");
            report_info(r, "(92)", setting, "particles of 1600 where it is violated", s.violated_92);
            report_info(r, "(93)", setting, "particles of 1600 where it is violated", s.violated_93);
            if (jittered)
                report_info(r, "Section 4.5", setting, "rows of 1600 that are not monotone", s.not_monotone);
            else
                elliptic_regression(r, "Section 4.5", setting, "rows of 1600 that are not monotone", known[k],
                                    s.not_monotone);
            report_info(r, "Section 4.5", setting,
                        "particles of 1600 without rows (neighbours too few or on a line)", s.failed);
            report_info(r, "Section 4.5", setting, "least 1 - xi . e", s.least);
            disagree += s.disagree;
            strict += s.strict;
            heterogeneous += fabs(s.heterogeneous - s.not_monotone);
            rows += 1600;
        }
    snprintf(text, sizeof text, "%g rows where (93) holds and the row is not monotone", disagree);
    report_claim(r, "Lemma 3", "all of the above", "(93) makes transmissibilities positive", "sufficient",
                 text, "none", disagree <= 0);
    snprintf(text, sizeof text, "the same rows are monotone with a random m (%g others)", heterogeneous);
    report_claim(r, "Theorem 4", "all of the above, m from 0.02 to 55", "scalar heterogeneous m", "monotone",
                 text, "no difference", heterogeneous <= 0);
    snprintf(text, sizeof text, "%g of %g rows", strict, rows);
    report_claim_fails(
        r, "Definition 7", "all of the above", "strictly diagonally dominant rows", "asked of an M-matrix",
        text,
        "rows of an operator sum to 0: dominance is weak, and irreducible once a Dirichlet row is reached");
}

/* ---------------------------------------------------------------- the inverse, whose sign is what monotone means */

/* Inverse of the n x n matrix a, by Gauss and Jordan with row exchanges, into b. Returns 0 if it is singular. */
static int invert_dense(int n, double *a, double *b)
{
    int i, j, k;
    for (i = 0; i < n * n; i++) b[i] = i / n == i % n;
    for (k = 0; k < n; k++) {
        int best = k;
        for (i = k; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[best * n + k])) best = i;
        if (!(fabs(a[best * n + k]) > 0)) return 0;
        for (j = 0; j < n && best != k; j++) {
            const double s = a[k * n + j], t = b[k * n + j];
            a[k * n + j] = a[best * n + j];
            b[k * n + j] = b[best * n + j];
            a[best * n + j] = s;
            b[best * n + j] = t;
        }
        for (i = 0; i < n; i++) {
            const double factor = a[i * n + k] / a[k * n + k];
            if (i == k || factor == 0) continue;
            for (j = k; j < n; j++) a[i * n + j] -= factor * a[k * n + j];
            for (j = 0; j < n; j++) b[i * n + j] -= factor * b[k * n + j];
        }
    }
    for (i = 0; i < n; i++)
        for (j = 0; j < n; j++) b[i * n + j] /= a[i * n + i];
    return 1;
}

/* smallest entry of the inverse over its largest, for -L in cells, scaled to a diagonal of 1 (some rows have the other sign), and u on the boundary; *others: rows that are not monotone.
   HUGE_VAL if singular. */
static double inverse_least(cloud *c, int N, double f, double jitter, pcg32 *g, int *others)
{
    double *a, *b, least = HUGE_VAL, most = 0;
    sph_index p, count;
    int i, n;
    cloud_cells(c, N);
    if (jitter > 0) cloud_perturb(c, jitter, g);
    cloud_neighbours(c, f * c->dx);
    cloud_rows(c, SCHEME_M, (sph_elliptic_options){0});
    count = sph_rows_monotone(sph_cloud_range(cloud_all(c), 0, N * N), c->row, sph_scalars_array(c->diagonal),
                              NULL);
    expect(count);
    *others = (int)count;
    n = c->n;
    a = (double *)need(NULL, 2 * (size_t)n * (size_t)n, sizeof *a);
    b = a + n * n;
    for (i = 0; i < n * n; i++) a[i] = 0;
    for (i = 0; i < n; i++) {
        a[i * n + i] = i < N * N && c->diagonal[i] == 0 ? 0 : 1; /* 0: no row */
        for (p = c->lists.start[i]; p < c->lists.start[i + 1] && i < N * N && c->diagonal[i] != 0; p++)
            a[i * n + c->lists.index[p]] += c->row[p] / c->diagonal[i];
    }
    if (invert_dense(n, a, b))
        for (i = 0; i < n * n; i++) {
            least = fmin(least, b[i]);
            most = fmax(most, fabs(b[i]));
        }
    free(a);
    return least < HUGE_VAL ? least / most : least;
}

static void inverses(report *r, cloud *c, const int draws)
{
    char text[160];
    int k, jittered, N, draw;
    report_section(r, "Section 4.5: sign of the inverse of the whole matrix, N x N cells, N = 2 to 8, "
                      "Dirichlet rows on the boundary");
    for (jittered = 0; jittered < 2; jittered++)
        for (k = 0; k < LAYOUTS; k++) {
            double worst_monotone = HUGE_VAL, worst = HUGE_VAL;
            int systems = 0, singular = 0, negative = 0, not_monotone = 0, not_monotone_negative = 0;
            pcg32 g;
            pcg32_seed(&g, 2020, 9);
            for (N = 2; N <= 8; N++)
                for (draw = 0; draw < (jittered ? draws : 1); draw++) {
                    int others;
                    const double least = inverse_least(c, N, layouts[k], jittered ? 0.1 : 0, &g, &others);
                    systems++;
                    if (!(least < HUGE_VAL)) {
                        singular++;
                        continue;
                    }
                    worst = fmin(worst, least);
                    negative += least < -1e-12;
                    if (others) {
                        not_monotone++;
                        not_monotone_negative += least < -1e-12;
                    } else worst_monotone = fmin(worst_monotone, least);
                }
            snprintf(setting, sizeof setting, "f = %g, %s", layouts[k],
                     jittered ? "10 % perturbed" : "uniform");
            snprintf(text, sizeof text,
                     "%d systems: %d singular, %d with a negative entry; rows not monotone in %d, %d of "
                     "these with a negative entry",
                     systems, singular, negative, not_monotone, not_monotone_negative);
            if (worst_monotone < HUGE_VAL)
                report_claim(r, "Section 4.5", setting, "A^-1 >= 0 if all rows are monotone",
                             "M-matrix is monotone", text, "no entry below -1e-12 of the largest",
                             worst_monotone >= -1e-12);
            else
                report_row(r, "Section 4.5", setting, "A^-1 >= 0", NULL, text, NULL,
                           "no system with monotone rows only", REPORT_INFO);
            if (worst < HUGE_VAL)
                report_info(r, "Section 4.5", setting, "least entry of an inverse / its largest", worst);
        }
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "every number of neighbours from 4 to 500, more random draws", OPTION_FLAG, &full, 0, 0},
    };
    static report r;
    cloud c = {0};
    options_parse(argc, argv,
                  "Figures 5 and 6 and the monotonicity of the paper on the elliptic operator, measured.",
                  specs, 3);
    report_open(&r, "elliptic_stability", out);
    figure_folder(figures, "elliptic_stability");
    figure5(&r, &c, figures);
    printed_tau(&r, &c);
    figure6(&r, &c, figures, full);
    monotonicity(&r, &c, full ? 30 : 5);
    inverses(&r, &c, full ? 30 : 5);
    cloud_close(&c);
    return report_close(&r) ? 1 : 0;
}
