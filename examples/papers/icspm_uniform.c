/* SPDX-License-Identifier: MIT
 *
 * icspm_uniform.c - tables 1, 2, 3 and figure 2 of the ICSPM paper, and what it claims in words about uniform particles.
 *
 *     cc -O2 -o icspm_uniform examples/papers/icspm_uniform.c -lm
 *     icspm_uniform -out DIR -figures DIR        (-h for help)
 */
#include <time.h>

#include "../common/options.h"
#include "../common/random.h"
#include "../common/report.h"
#include "icspm.h"
#include "laplacian_kernel.h"

/* Table 1: direct, c = 2 */
static const double table1_e[METHODS][LEVELS] = {{1.417163e+01, 1.429096e+01, 1.432149e+01, 1.432916e+01,
                                                  1.433108e+01, 1.433156e+01, 1.433168e+01, 1.433171e+01},
                                                 {2.541300e-01, 6.336412e-01, 1.535954e+00, 3.585439e+00,
                                                  7.712388e+00, 1.597336e+01, 3.249707e+01, 6.554494e+01},
                                                 {7.718045e-01, 1.965008e-01, 4.934995e-02, 1.235158e-02,
                                                  3.088777e-03, 7.722492e-04, 1.930658e-04, 4.826679e-05}};
static const double table1_p[METHODS][LEVELS] = {
    {0, -0.0121, -0.0031, -0.0008, -0.0002, -0.0000, -0.0000, -0.0000},
    {0, -1.3181, -1.2774, -1.2230, -1.1050, -1.0504, -1.0246, -1.0122},
    {0, 1.9737, 1.9934, 1.9984, 1.9996, 1.9999, 2.0000, 2.0000}};
/* Table 2: direct, BIM, c = k^2 */
static const double table2_e[LEVELS] = {3.089736e+00, 3.212382e-01, 4.607038e-01, 3.741568e-01,
                                        2.328916e-01, 1.223207e-01, 5.701353e-02, 2.433353e-02};
static const double table2_p[LEVELS] = {0, 3.2658, -0.5202, 0.3002, 0.6840, 0.9290, 1.1013, 1.2284};
/* Table 3: boundary value problem; c = 2, for BIM k^2 */
static const double table3_e[METHODS][LEVELS] = {{8.904183e-02, 2.483635e-02, 6.473150e-03, 1.646873e-03,
                                                  4.149916e-04, 1.041376e-04, 2.608189e-05, 6.526331e-06},
                                                 {4.294576e-02, 6.346824e-03, 8.987147e-03, 6.850803e-03,
                                                  3.860040e-03, 1.885634e-03, 8.424516e-04, 3.528668e-04},
                                                 {5.251809e-03, 1.267271e-03, 3.155887e-04, 7.870952e-05,
                                                  1.967555e-05, 4.918146e-06, 1.229500e-06, 3.073762e-07}};
static const double table3_p[METHODS][LEVELS] = {{0, 1.8420, 1.9399, 1.9747, 1.9886, 1.9946, 1.9974, 1.9987},
                                                 {0, 2.7584, -0.5018, 0.3916, 0.8277, 1.0336, 1.1624, 1.2555},
                                                 {0, 2.0511, 2.0056, 2.0034, 2.0001, 2.0002, 2.0000, 2.0000}};

static char setting[64];
static const char *at(const char *what, int n)
{
    snprintf(setting, sizeof setting, "%s, N = %d", what, n);
    return setting;
}

/* One column of a table. The paper's own ICSPM values at N = 641 and 1281 are limited by round-off (extended precision moves them by as much as they are off here). */
static void column(report *r, const char *item, int method, const double *measured, const double *published_e,
                   const double *published_p)
{
    int k;
    for (k = 0; k < LEVELS; k++) {
        const int n = icspm_size(k);
        const double tolerance = method != ICSPM || n < 641 ? 1e-6 : n < 1281 ? 2e-6 : 2e-5;
        report_relative(r, item, at(icspm_method_name[method], n), "e_N", published_e[k], measured[k],
                        tolerance);
        if (k > 0)
            report_absolute(r, item, at(icspm_method_name[method], n), "p_N", published_p[k],
                            icspm_order(measured[k - 1], measured[k]), 1e-4);
    }
}

static void tables(report *r, line *s, double bvp[METHODS][LEVELS])
{
    double e[LEVELS];
    int method, k;
    report_section(r, "Table 1: f'' of a known f, uniform particles, c = 2");
    for (method = 0; method < METHODS; method++) {
        for (k = 0; k < LEVELS; k++) {
            line_uniform(s, icspm_size(k), 2);
            e[k] = line_direct_error(s, method);
        }
        column(r, "Table 1", method, e, table1_e[method], table1_p[method]);
    }
    report_section(r, "Table 2: BIM with growing c = k^2");
    for (k = 0; k < LEVELS; k++) {
        line_uniform(s, icspm_size(k), icspm_c(BIM, k));
        e[k] = line_direct_error(s, BIM);
    }
    column(r, "Table 2", BIM, e, table2_e, table2_p);
    report_section(r, "Table 3: the boundary value problem (5.18), uniform particles");
    for (method = 0; method < METHODS; method++) {
        for (k = 0; k < LEVELS; k++) {
            line_uniform(s, icspm_size(k), icspm_c(method, k));
            bvp[method][k] = line_bvp_error(s, method);
        }
        column(r, "Table 3", method, bvp[method], table3_e[method], table3_p[method]);
    }
}

/* Figure 2: f'' by the three methods, N = 41, h = 1/20 */
static void figure2(line *s, const char *dir)
{
    FILE *out = figure_open(dir, "icspm_fig2");
    double value[METHODS][LARGEST];
    int method, i;
    line_uniform(s, 41, 2);
    for (method = 0; method < METHODS; method++) {
        line_second_derivative(s, method);
        for (i = 0; i < s->n; i++) value[method][i] = s->status[i] == SPH_OK ? s->value[i] : HUGE_VAL;
    }
    fprintf(out, "x,exact,CSPM,BIM,ICSPM\n");
    for (i = 0; i < s->n; i++) {
        fprintf(out, "%.9g,%.9g,%.9g,", s->x[i], icspm_d2f(s->x[i]), value[CSPM][i]);
        if (value[BIM][i] < HUGE_VAL)
            fprintf(out, "%.9g", value[BIM][i]); /* empty at the ends, where BIM has no value */
        fprintf(out, ",%.9g\n", value[ICSPM][i]);
    }
    figure_close(out);
}

/* ---------------------------------------------------------------- claims in words */

/* 'second-order accurate in the interior, first-order for x close to a boundary' (section IV.I): the first derivative */
static void first_derivative(report *r, line *s)
{
    double inside[2] = {0, 0}, end[2] = {0, 0};
    int level, i;
    report_section(r, "Section III: order of the CSPM first derivative");
    for (level = 0; level < 2; level++) {
        const int n = level ? 321 : 161;
        line_uniform(s, n, 2);
        expect(sph_gradient_cspm(ICSPM_KERNEL, 1, line_cloud(s), sph_scalars_array(s->f),
                                 (sph_derivatives_out){.gx = s->value}));
        for (i = 0; i < n; i++) {
            const double e = fabs(s->value[i] - icspm_df(s->x[i]));
            double *const worst = s->x[i] >= 0.25 && s->x[i] <= 0.75 ? inside : end;
            if (e > worst[level]) worst[level] = e;
        }
    }
    report_range(r, "Section III", "interior, N = 161 to 321", "order of <f'>", 2,
                 icspm_order(inside[0], inside[1]), 1.95, 2.05);
    report_range(r, "Section III", "boundary, N = 161 to 321", "order of <f'>", 1,
                 icspm_order(end[0], end[1]), 0.95, 1.05);
}

/* (4.12), with its sign mended: the error of CSPM is (kappa - 1) f'', up to O(h) */
static void cspm_prediction(report *r, line *s)
{
    static const int sizes[] = {41, 161, 641};
    double kappa[LARGEST], off[3];
    int k, i;
    report_section(r, "Section IV.III: the error of CSPM against its own prediction (kappa - 1) f''");
    for (k = 0; k < 3; k++) {
        line_uniform(s, sizes[k], 2);
        line_second_derivative(s, ICSPM);
        for (i = 0; i < s->n; i++) kappa[i] = s->conditioning[i];
        line_second_derivative(s, CSPM);
        off[k] = 0;
        for (i = 0; i < s->n; i++) {
            const double e = fabs(s->value[i] - icspm_d2f(s->x[i]) - (kappa[i] - 1) * icspm_d2f(s->x[i]));
            if (e > off[k]) off[k] = e;
        }
        report_info(r, "(4.12)", at("all particles", s->n), "max |error - (kappa - 1) f''|", off[k]);
    }
    /* f''' = 0 at both ends, which makes even this remainder second order */
    report_range(r, "(4.12)", "N = 161 to 641", "order of the remainder", (double)NAN,
                 0.5 * icspm_order(off[1], off[2]), 0.9, 2.1);
}

/* 'an increasing c in ICSPM makes the order of convergence take a lower value than 2' */
static void growing_c(report *r, line *s)
{
    double direct[2][LEVELS], bvp[LEVELS];
    int k;
    report_section(r, "Section V.I: ICSPM and CSPM with growing c = k^2");
    for (k = 0; k < LEVELS; k++) {
        line_uniform(s, icspm_size(k), (k + 1.0) * (k + 1.0));
        direct[0][k] = line_direct_error(s, CSPM);
        direct[1][k] = line_direct_error(s, ICSPM);
        if (line_second_derivative(s, ICSPM) > 0)
            direct[1][k] = (double)NAN; /* k = 1: the ends have one neighbour */
        bvp[k] = line_bvp_error(s, ICSPM);
        report_info(r, "growing c", at("CSPM direct", s->n), "e_N", direct[0][k]);
        if (k > 0) report_info(r, "growing c", at("ICSPM direct", s->n), "e_N", direct[1][k]);
        report_info(r, "growing c", at("ICSPM boundary value problem", s->n), "e_N", bvp[k]);
    }
    line_uniform(s, 11, 1);
    line_second_derivative(s, ICSPM);
    report_claim(r, "growing c", "ICSPM direct, N = 11, c = 1", "end particles", NULL,
                 sph_status_text(s->status[0]), "one neighbour: too few, and said so",
                 s->status[0] == SPH_TOO_FEW);
    report_range(r, "growing c", "ICSPM direct, N = 21 to 1281", "mean order (paper: below 2)", (double)NAN,
                 icspm_order(direct[1][1], direct[1][7]) / 6, -2, 2);
    report_range(r, "growing c", "ICSPM problem, N = 11 to 1281", "mean order (paper: below 2)", (double)NAN,
                 icspm_order(bvp[0], bvp[7]) / 7, -2, 2);
}

/* Particles in the middle of n equal cells, and the ends as particles without volume, because BIM needs f there. */
static void cell_centred(line *s, int cells, double c)
{
    int i;
    s->n = cells + 2;
    s->x[0] = 0;
    s->x[cells + 1] = 1;
    s->V[0] = s->V[cells + 1] = 0;
    for (i = 0; i < cells; i++) {
        s->x[i + 1] = (i + 0.5) / cells;
        s->V[i + 1] = 1.0 / cells;
    }
    line_sample(s, icspm_f);
    line_neighbours(s, c / cells);
}

/* 'the difference in the numerical results is negligible' (finite-volume-like against finite-difference-like positions) */
static void layouts(report *r, line *s)
{
    static const int size[2] = {161, 321};
    double e[2][2][METHODS]; /* level, layout, method */
    char text[128];
    int method, level;
    report_section(r, "Section V.I: particles in cell centres against particles on the ends");
    for (method = 0; method < METHODS; method++)
        for (level = 0; level < 2; level++) {
            const double c = icspm_c(method, 4 + level);
            line_uniform(s, size[level], c);
            e[level][0][method] = line_direct_error(s, method);
            cell_centred(s, size[level] - 1, c);
            line_second_derivative(s, method);
            s->status[0] = s->status[s->n - 1] = SPH_NOT_AVAILABLE; /* probes, not particles */
            e[level][1][method] = line_error(s, icspm_d2f);
            report_info(r, "layout", at(icspm_method_name[method], size[level]), "e_N, end particles",
                        e[level][0][method]);
            report_info(r, "layout", at(icspm_method_name[method], size[level]), "e_N, cell centres",
                        e[level][1][method]);
        }
    for (method = 0; method < METHODS; method++) {
        const double ratio = e[1][1][method] / e[1][0][method];
        snprintf(text, sizeof text, "errors differ by a factor of %.3g, orders %.2f and %.2f", ratio,
                 icspm_order(e[0][0][method], e[1][0][method]),
                 icspm_order(e[0][1][method], e[1][1][method]));
        if (method == ICSPM)
            report_claim_fails(r, "layout", "ICSPM direct, N = 321", "difference", "negligible", text,
                               "what ICSPM has left is an error at the ends, which depends on where the last "
                               "particle is; the order is the same");
        else
            report_claim(r, "layout", at(icspm_method_name[method], 321), "difference", "negligible", text,
                         "within 5 %", fabs(ratio - 1) < 0.05);
    }
}

/* Sparsity and cost of the rows. Times are information: they depend on the machine. */
static void cost(report *r, line *s)
{
    int method, k, repeat;
    report_section(r, "Section V.I: nonzeros and cost of a row");
    for (method = 0; method < METHODS; method++)
        for (k = 0; k < LEVELS; k += 7) {
            clock_t t;
            const int repeats = k ? 20 : 2000;
            line_uniform(s, icspm_size(k), icspm_c(method, k));
            report_info(r, "cost", at(icspm_method_name[method], s->n),
                        "nonzeros per row (mean, with the diagonal)", 1 + (double)s->near.found.pairs / s->n);
            t = clock();
            for (repeat = 0; repeat < repeats; repeat++) line_rows(s, method);
            report_info(r, "cost", at(icspm_method_name[method], s->n), "assembly, ns per row",
                        1e9 * (double)(clock() - t) / CLOCKS_PER_SEC / repeats / s->n);
            t = clock();
            for (repeat = 0; repeat < repeats; repeat++) line_second_derivative(s, method);
            report_info(r, "cost", at(icspm_method_name[method], s->n), "direct, ns per particle",
                        1e9 * (double)(clock() - t) / CLOCKS_PER_SEC / repeats / s->n);
        }
}

/* The operators that the introduction dismisses: with the second derivative of the kernel ('very sensitive to particle disorder'), and with the first derivative and no
   boundary terms. Max error in the interior (0.25 <= x <= 0.75) and everywhere; jitter 0.25 dx. */
static void dismissed(report *r, line *s)
{
    double inside[2][2], all[2][2];
    int jittered, which, i;
    report_section(r, "Section I: the operators that the introduction dismisses, N = 161, c = 2");
    for (jittered = 0; jittered < 2; jittered++) {
        pcg32 g;
        pcg32_seed(&g, 2017, 1);
        line_uniform(s, 161, 2);
        if (jittered) {
            for (i = 1; i < s->n - 1; i++) s->x[i] += 0.25 / (s->n - 1) * (2 * pcg32_uniform(&g) - 1);
            line_volumes(s);
            line_sample(s, icspm_f);
            line_neighbours(s, 2.0 / (s->n - 1));
        }
        for (which = 0; which < 2; which++) {
            const char *const name =
                which ? "second kernel derivative" : "first derivative, no boundary terms";
            const sph_cloud cloud = line_cloud(s);
            const sph_scalars f = sph_scalars_array(s->f);
            const sph_scalar_out out = sph_scalar_out_array(s->value, 0);
            char text[96];
            if (which) laplacian_kernel(ICSPM_KERNEL, 1, cloud, f, s->value);
            else expect(sph_laplacian_brookshaw(ICSPM_KERNEL, 1, cloud, f, out));
            inside[which][jittered] = all[which][jittered] = 0;
            for (i = 0; i < s->n; i++) {
                const double e = fabs(s->value[i] - icspm_d2f(s->x[i]));
                if (e > all[which][jittered]) all[which][jittered] = e;
                if (s->x[i] >= 0.25 && s->x[i] <= 0.75 && e > inside[which][jittered])
                    inside[which][jittered] = e;
            }
            snprintf(text, sizeof text, "%s, %s", name, jittered ? "jittered" : "uniform");
            report_info(r, "dismissed", text, "max error, interior", inside[which][jittered]);
            report_info(r, "dismissed", text, "max error, all", all[which][jittered]);
        }
    }
    report_range(r, "dismissed", "second kernel derivative, interior",
                 "error in disorder / uniform (very sensitive: > 100)", (double)NAN,
                 inside[1][1] / inside[1][0], 100, HUGE_VAL);
    report_range(r, "dismissed", "jittered, interior", "second / first derivative (worse: > 1)", (double)NAN,
                 inside[1][1] / inside[0][1], 1, HUGE_VAL);
    report_range(r, "dismissed", "first derivative, uniform",
                 "error at the ends / interior (boundaries ruin it: > 100)", (double)NAN,
                 all[0][0] / inside[0][0], 100, HUGE_VAL);
}

/* A function with f''' != 0 at the ends */
static double other_f(double x) { return sin(2 * x + 0.5); }
static double other_d2f(double x) { return -4 * sin(2 * x + 0.5); }

/* 'second-order ... is only due to the uniform distribution of the particles' */
static void second_order_reason(report *r, line *s)
{
    double direct[2], bvp[2], inside[2] = {0, 0};
    char text[128];
    int level, i;
    report_section(r,
                   "Section V.I: why ICSPM shows second order: f = sin(2x + 1/2), uniform particles, c = 2");
    for (level = 0; level < 2; level++) {
        line_uniform(s, level ? 321 : 161, 2);
        line_sample(s, other_f);
        line_second_derivative(s, ICSPM);
        direct[level] = line_error(s, other_d2f);
        for (i = 0; i < s->n; i++)
            if (s->x[i] >= 0.25 && s->x[i] <= 0.75)
                inside[level] = fmax(inside[level], fabs(s->value[i] - other_d2f(s->x[i])));
        line_solve(s, ICSPM, other_f, other_d2f);
        bvp[level] = line_error(s, other_f);
    }
    report_range(r, "ICSPM order", "direct, all particles", "p, N = 161 to 321 (derived in the paper: 1)", 1,
                 icspm_order(direct[0], direct[1]), 0.9, 1.1);
    report_range(report_beside(r, REPORT_THEORY), "ICSPM order", "direct, interior", "p, N = 161 to 321", 2,
                 icspm_order(inside[0], inside[1]), 1.9, 2.1);
    report_range(report_beside(r, REPORT_THEORY), "ICSPM order", "boundary value problem", "p, N = 161 to 321", 2,
                 icspm_order(bvp[0], bvp[1]), 1.9, 2.1);
    snprintf(text, sizeof text, "p = %.3f for another f on the same particles",
             icspm_order(direct[0], direct[1]));
    report_claim_fails(r, "ICSPM order", "direct, uniform", "cause of second order in Table 1",
                       "the uniform distribution", text,
                       "f''' = pi^3 sin(pi x) vanishes at both ends for the paper's f; that is the cause");
}

/* 'the error with ICSPM is one order of magnitude smaller than with CSPM' (Table 3) */
static void table3_ratio(report *r, double bvp[METHODS][LEVELS])
{
    double least = HUGE_VAL;
    int k;
    for (k = 0; k < LEVELS; k++) least = fmin(least, bvp[CSPM][k] / bvp[ICSPM][k]);
    report_section(r, "Section V.I: ICSPM against CSPM in Table 3");
    report_range(r, "Table 3", "all N", "smallest CSPM / ICSPM (about 10 or more)", 10, least, 10, HUGE_VAL);
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "the same: nothing here is cut short", OPTION_FLAG, &full, 0, 0},
    };
    double bvp[METHODS][LEVELS];
    static report r;
    line s;
    options_parse(argc, argv, "Tables 1, 2, 3 and figure 2 of the ICSPM paper: published against measured.",
                  specs, 3);
    report_open(&r, "icspm_uniform", out);
    figure_folder(figures, "icspm_uniform");
    line_open(&s, LARGEST + 1);
    tables(&r, &s, bvp);
    table3_ratio(&r, bvp);
    figure2(&s, figures);
    first_derivative(&r, &s);
    cspm_prediction(&r, &s);
    growing_c(&r, &s);
    layouts(&r, &s);
    cost(&r, &s);
    dismissed(&r, &s);
    second_order_reason(&r, &s);
    line_close(&s);
    return report_close(&r) ? 1 : 0;
}
