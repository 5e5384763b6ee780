/* SPDX-License-Identifier: MIT
 *
 * elliptic_clouds - what the elliptic paper lacks: its boundary value problems, and smooth ones, on particles in all states of disorder, with the error in
 * the relative L2 norm itself (its tables print 100/N of theirs, which looks like one order more), the observed order, and the share of rows that are not
 * those of an M-matrix.
 *
 * Problems: the paper's Dirichlet and mixed ones, whose data jump in the corners of the unit square; div(m grad u) = s with smooth m, u and s, u given on
 * all faces, or on y = 0 and the fluxes elsewhere; and the first of these in the unit cube.
 * Clouds: the paper's cells (uniform); their inner particles moved by up to 10 % or 25 % of dx; Poisson discs; Poisson discs whose spacing and h double from
 * x = 0 to x = 1. h = 1.2 spacings (some 20 neighbours in 2D, 60 in 3D), V = dx^dim on uniform particles, else 1 / sum W.
 * Schemes: B Brookshaw, CB corrected Brookshaw, M M-SPH (the same numbers as Schwaiger's scheme), M (16) with the gradient (16), M / trace with rows scaled
 * so that |x|^2 is exact, too.
 *
 * What can be derived, and is asserted (bounds of errors, so 'order at least that', less 0.3 for the next term of the error):
 *   - On uniform particles M-SPH has errors O(dx^2) inside and O(1) in the layers next to the boundary, where supports are cut. Beside a Dirichlet face a
 *     source O(1) in a layer dx thick changes u by O(dx^2): order 2. Beside a flux condition, whose own error is O(dx), it acts like a flux O(dx): order 1.
 *   - A jump of the data in a corner makes the solution a function of r / dx there, with errors that fall off like (dx / r)^2: O(dx) in L2, order 1. This is
 *     all that the paper's own Dirichlet problem can show.
 *   - Brookshaw's rows, corrected or not, have positive weights only (F <= 0), and so have M-SPH's on uniform particles out of reach of the boundary (xi = 0).
 *   - Without a source and with m = 1 rows may be multiplied by anything: B = CB and M = M / trace for the paper's problems. That is why its tables cannot see
 *     the error that stays in disorder (see scatter_trace). The smooth problems do: M stops between 2e-4 and 2e-3 in 2D, M / trace goes on to 3e-5 ... 7e-5 at N = 80.
 *
 *     elliptic_clouds [-out DIR] [-figures DIR] [-full]
 */
#include "elliptic_reference.h"

#include "elliptic_scatter.h"

#include "../common/options.h"
#include "../common/progress.h"
#include "../common/report.h"
#include "../common/statistics.h"

enum { DIRICHLET, MIXED, SMOOTH, FLUXES, PROBLEMS };
static const char *const problem_name[PROBLEMS] = {"Dirichlet", "mixed", "smooth", "smooth with fluxes"};
enum { UNIFORM, JITTER_10, JITTER_25, DISCS, GRADED, CLOUDS };
static const char *const cloud_name[CLOUDS] = {"uniform", "jitter 10 %", "jitter 25 %", "Poisson discs",
                                               "graded discs"};
enum { B, CB, M, M16, M_TRACE, METHODS };
static const char *const method_name[METHODS] = {"B", "CB", "M", "M (16)", "M / trace"};
enum { MOST_LEVELS = 4, TERMS = 100 };

/* m = 1 + x / 2 + 0.3 y^2 + 0.2 z; u = sin(2 x + 1/2) cos(1.5 y) + 0.4 x y z + z^2 / 2, in 2D with z = 0 */
static double mobility(sph_vec p) { return 1 + 0.5 * p.x + 0.3 * p.y * p.y + 0.2 * p.z; }
static double solution(sph_vec p)
{
    return sin(2 * p.x + 0.5) * cos(1.5 * p.y) + 0.4 * p.x * p.y * p.z + 0.5 * p.z * p.z;
}
static sph_vec solution_gradient(sph_vec p)
{
    sph_vec g;
    g.x = 2 * cos(2 * p.x + 0.5) * cos(1.5 * p.y) + 0.4 * p.y * p.z;
    g.y = -1.5 * sin(2 * p.x + 0.5) * sin(1.5 * p.y) + 0.4 * p.x * p.z;
    g.z = 0.4 * p.x * p.y + p.z;
    return g;
}
/* div(m grad u) */
static double source(int dim, sph_vec p)
{
    const sph_vec g = solution_gradient(p);
    const double laplacian = -6.25 * sin(2 * p.x + 0.5) * cos(1.5 * p.y) + (dim > 2 ? 1 : 0);
    return mobility(p) * laplacian + 0.5 * g.x + 0.6 * p.y * g.y + (dim > 2 ? 0.2 * g.z : 0);
}

static void make_cloud(scatter *s, int dim, int kind, int N)
{
    pcg32 g;
    pcg32_seed(&g, 2020, (uint64_t)(100 * kind + N));
    if (kind <= JITTER_25) {
        scatter_cells(s, dim, N);
        if (kind != UNIFORM) cloud_perturb(&s->c, kind == JITTER_10 ? 0.1 : 0.25, &g);
    } else scatter_discs(s, dim, N, kind == GRADED ? 1 : 0, &g);
    scatter_neighbours(s, 1.2);
    if (kind != UNIFORM) scatter_volumes(s);
}

/* The problem's data at every particle: exact solution, right-hand side, mobility, and whether a boundary particle is a Dirichlet one; normals. */
typedef struct data {
    double *exact, *b, *alpha, *beta, *normal[3];
} data;
static void data_of(scatter *s, int problem, data *d)
{
    cloud *const c = &s->c;
    int i, a;
    d->exact = elliptic_vector(c->n);
    d->b = elliptic_vector(c->n);
    d->alpha = elliptic_vector(c->n);
    d->beta = elliptic_vector(c->n);
    for (a = 0; a < 3; a++) d->normal[a] = elliptic_vector(c->n);
    for (i = 0; i < c->n; i++) {
        const sph_vec p = {c->x[i], c->y[i], c->z[i]};
        const int smooth = problem >= SMOOTH, face = p.y == 0   ? 0
                                                     : p.x == 1 ? 1
                                                     : p.y == 1 ? 2
                                                                : 3; /* in 2D: the order of the paper's psi */
        c->m[i] = smooth ? mobility(p) : 1;
        if (i < s->inner) {
            d->exact[i] = smooth ? solution(p)
                          : problem == DIRICHLET
                              ? elliptic_series_dirichlet(p.x, p.y, 1, 1, elliptic_psi_dirichlet, TERMS)
                              : elliptic_series_mixed(p.x, p.y, 1, 1, elliptic_psi_mixed, TERMS);
            d->b[i] = smooth ? source(c->dim, p) : 0;
            continue;
        }
        for (a = 0; a < c->dim; a++)
            d->normal[a][i] = cloud_axis(c, a)[i] == 0 ? -1 : cloud_axis(c, a)[i] == 1 ? 1 : 0;
        d->alpha[i] = problem == DIRICHLET || problem == SMOOTH || face == 0;
        d->beta[i] = 1 - d->alpha[i];
        if (!smooth) d->b[i] = problem == DIRICHLET ? elliptic_psi_dirichlet[face] : elliptic_psi_mixed[face];
        else {
            const sph_vec g = solution_gradient(p);
            d->b[i] = d->alpha[i] > 0
                          ? solution(p)
                          : c->m[i] * (d->normal[0][i] * g.x + d->normal[1][i] * g.y + d->normal[2][i] * g.z);
        }
    }
}
static void data_free(data *d)
{
    int a;
    free(d->exact);
    free(d->b);
    free(d->alpha);
    free(d->beta);
    for (a = 0; a < 3; a++) free(d->normal[a]);
}

static void rows_of(scatter *s, int method)
{
    scatter_rows(s,
                 method == B    ? SCHEME_B
                 : method == CB ? SCHEME_CB
                                : SCHEME_M,
                 method == M16       ? SCATTER_FULL
                 : method == M_TRACE ? SCATTER_TRACE
                                     : SCATTER_PLAIN,
                 0);
}

static double solve_problem(scatter *s, int problem, int method)
{
    double *b, error;
    data d;
    sparse A;
    int i;
    data_of(s, problem, &d);
    b = d.b;
    rows_of(s, method);
    scatter_conditions(s, s->inner, d.normal, d.alpha, d.beta);
    cloud_matrix(&s->c, &A, b);
    for (i = 0; i < s->c.n; i++) s->c.u[i] = 0;
    elliptic_solve(&A, b, s->c.u);
    error = scatter_error(s, s->c.u, d.exact);
    sparse_free(&A);
    data_free(&d);
    return error;
}

/* What the order is at least, on uniform particles, for the schemes that are exact for linear fields everywhere; 0: nothing is known */
static double order_of(int problem, int kind, int method)
{
    return kind != UNIFORM || method < M ? 0 : problem == SMOOTH ? 2 : 1;
}

/* rows in s->c.row that are not those of an M-matrix; *deep: those of them out of reach of the boundary */
static int rows_lost(const scatter *s, int *deep)
{
    unsigned char *const monotone = (unsigned char *)need(NULL, (size_t)s->c.n, 1);
    const sph_cloud inner = sph_cloud_range(scatter_cloud(s), 0, s->inner);
    const int lost = (int)sph_rows_monotone(inner, s->c.row, sph_scalars_array(s->c.diagonal), monotone);
    int i;
    expect(lost);
    *deep = 0;
    for (i = 0; i < s->inner; i++)
        *deep += !monotone[i] && s->c.depth[i] > s->h[i] * sph_kernel_support_ratio(ELLIPTIC_KERNEL);
    free(monotone);
    return lost;
}

static void convergence(report *r, FILE *csv, progress *bar, scatter *s, int dim, int kind, const int *sides,
                        int levels)
{
    double error[PROBLEMS][METHODS][MOST_LEVELS];
    char item[32], setting[64], title[96];
    int k, problem, method, lost, deep;
    const int first = dim == 2 ? DIRICHLET : SMOOTH, last = dim == 2 ? FLUXES : SMOOTH;
    snprintf(item, sizeof item, "%dD %s", dim, cloud_name[kind]);
    snprintf(title, sizeof title, "%dD, %s", dim, cloud_name[kind]);
    report_section(r, title);
    for (k = 0; k < levels; k++) {
        make_cloud(s, dim, kind, sides[k]);
        for (method = 0; method < METHODS; method++) {
            double mean = 0;
            int i;
            for (i = 0; i < s->c.n; i++) s->c.m[i] = 1;
            rows_of(s, method);
            lost = rows_lost(s, &deep);
            snprintf(setting, sizeof setting, "%s, N = %d, %d particles", method_name[method], sides[k],
                     s->inner);
            if (method <= CB) report_range(r, item, setting, "rows not monotone", (double)NAN, lost, 0, 0);
            else report_info(r, item, setting, "rows not monotone", lost);
            report_info(r, item, setting, "their share", (double)lost / s->inner);
            if (kind == UNIFORM)
                report_range(r, item, setting, "out of reach of the boundary", (double)NAN, deep, 0, 0);
            else report_info(r, item, setting, "out of reach of the boundary", deep);
            for (i = 0; i < s->inner; i++) mean += (scatter_trace(s, i) - 1) / s->inner;
            report_info(r, item, setting, "mean of trace - 1", mean);
            for (problem = first; problem <= last; problem++) {
                error[problem][method][k] = solve_problem(s, problem, method);
                fprintf(csv, "%d,%s,%s,%s,%d,%.9g,%.6g,%.6g\n", dim, cloud_name[kind], problem_name[problem],
                        method_name[method], sides[k], error[problem][method][k], (double)lost / s->inner,
                        mean);
            }
            progress_update(bar, (method + 1.0) / METHODS);
        }
        for (problem = first; problem <= last && problem < SMOOTH; problem++) {
            double(*const e)[MOST_LEVELS] = error[problem];
            snprintf(setting, sizeof setting, "%s, N = %d", problem_name[problem], sides[k]);
            report_range(r, item, setting, "|CB - B| / B of the errors", (double)NAN,
                         fabs(e[CB][k] - e[B][k]) / e[B][k], 0, 1e-6);
            report_range(r, item, setting, "|M / trace - M| / M", (double)NAN,
                         fabs(e[M_TRACE][k] - e[M][k]) / e[M][k], 0, 1e-6);
        }
    }
    for (problem = first; problem <= last; problem++)
        for (method = 0; method < METHODS; method++) {
            const double order = order_of(problem, kind, method);
            double size[MOST_LEVELS], logs[MOST_LEVELS], slope;
            for (k = 0; k < levels; k++) {
                snprintf(setting, sizeof setting, "%s, %s, N = %d", problem_name[problem],
                         method_name[method], sides[k]);
                report_info(r, item, setting, "relative L2 error", error[problem][method][k]);
                size[k] = log(sides[k]);
                logs[k] = -log(error[problem][method][k]);
            }
            slope = statistics_slope(size, logs, levels);
            snprintf(setting, sizeof setting, "%s, %s, least squares", problem_name[problem],
                     method_name[method]);
            if (order > 0) report_range(r, item, setting, "order", (double)NAN, slope, order - 0.3, HUGE_VAL);
            else report_info(r, item, setting, "order", slope);
        }
}

int main(int argc, char **argv)
{
    static const int sides2[] = {10, 20, 40, 80}, sides3[] = {8, 16, 24};
    const char *out = ".", *figures = ".";
    int full = 0, quiet = 0, dim, kind;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "one finer cloud each", OPTION_FLAG, &full, 0, 0},
        {"quiet", "no progress line", OPTION_FLAG, &quiet, 0, 0},
    };
    static report r;
    scatter s = {0};
    progress bar;
    FILE *csv;
    options_parse(
        argc, argv,
        "The elliptic operator on particles in all states of disorder: true errors, orders, monotone rows.",
        specs, 4);
    report_open(&r, "elliptic_clouds", out);
    figure_folder(figures, "elliptic_clouds");
    csv = figure_open(figures, "elliptic_clouds_errors");
    fprintf(csv, "dim,cloud,problem,scheme,N,error,lost,trace\n");
    for (dim = 2; dim <= 3; dim++)
        for (kind = UNIFORM; kind < (dim == 2 ? CLOUDS : GRADED); kind++) {
            progress_begin(&bar, cloud_name[kind], quiet);
            convergence(&r, csv, &bar, &s, dim, kind, dim == 2 ? sides2 : sides3, (dim == 2 ? 3 : 2) + full);
            progress_end(&bar);
        }
    figure_close(csv);
    scatter_close(&s);
    return report_close(&r) ? 1 : 0;
}
