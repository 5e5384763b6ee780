/* SPDX-License-Identifier: MIT
 *
 * cleaning_projection.c - beyond the paper on divergence cleaning: div B taken away at once, by projection, beside the waves of hyperbolic cleaning.
 *
 *     cc -O2 -o cleaning_projection examples/papers/cleaning_projection.c -lm
 *     cleaning_projection -out DIR -figures DIR [-full]       (-h for help)
 *
 * The field is the peak of (40) in a periodic square of 2 x 2, rho = 1, in particles at rest: 50 x 50 on a lattice, and the same moved off it at random by up to a fifth of a spacing; -full: 100 x 100.
 * D is the divergence in difference form, G the gradient in symmetric form, as hyperbolic cleaning uses them, (20) and (23): each is minus the adjoint of the other in the product sum m/rho. Then
 *     exact projection         D G phi = D B,  B' = B - G phi:   conjugate gradients, a step of which is two sweeps of sph_cleaning_rates: no matrix. D B' is 0 to the solver's tolerance, and
 *                              |B'|^2 = |B|^2 - |G phi|^2: of all fields with D B' = 0 it is the nearest one
 *     approximate projection   L phi = D B with the rows of Brookshaw's Laplacian, B' = B - grad phi, corrected:   the rows and the solver of common/sparse.h. L is not D grad, and D B' is not 0
 *     hyperbolic cleaning      sigma = 0.3, until waves have crossed 3.2, as in cleaning_advection
 * The cost is told in sweeps over all particles. With any of them other divergences, that of corrected gradients or the symmetric one, see a B' that is as good as their own errors are.
 */
#include "../common/sparse.h"
#include "cleaning.h"

#define KERNEL SPH_CUBIC_SPLINE

enum { BX, BY, GX, GY, NONE_X, NONE_Y, PSI, ZERO, ZERO_Y, RATE_PSI, DIV, V, PHI, RESIDUAL, DIRECTION, IMAGE, WX, WY, ARRAYS };
typedef struct cloud {
    sph_index n;
    double h, *x[3], *rho, *a[ARRAYS];
    search near;
    long sweeps;
} cloud;
static sph_scalars field(const cloud *c, int which) { return sph_scalars_array(c->a[which]); }
static sph_cloud cloud_of(const cloud *c)
{
    return sph_cloud_of(sph_points_periodic(sph_points_separate(c->n, c->x[0], c->x[1], NULL), 2, 2, 0), c->near.found.list, sph_scalars_same(&c->h), field(c, V));
}
static const double one = 1;
static sph_medium medium(const cloud *c)
{
    static double m;
    sph_medium s;
    m = 4.0 / c->n;
    s.m = sph_scalars_same(&m);
    s.rho = sph_scalars_array(c->rho);
    s.omega = sph_scalars_same(&one);
    return s;
}
/* DIV = D of the field from array `from` on; -G of array psi to arrays `to`; RATE_PSI */
static void sweep(cloud *c, int from, int psi, int to, double ch, double sigma)
{
    const sph_cleaning s = {.medium = medium(c), .field = vectors_of(c->a + from, 2), .psi = field(c, psi), .div_v = sph_scalars_none(), .ch = ch, .sigma = sigma};
    const sph_cleaning_out out = {.rate_B = vectors_into(c->a + to, 2), .rate_psi = c->a[RATE_PSI], .div_B = c->a[DIV]};
    expect_all(sph_cleaning_rates(KERNEL, 2, cloud_of(c), s, out));
    c->sweeps++;
}
static double product(const cloud *c, int p, int q)
{
    double sum = 0;
    sph_index i;
    for (i = 0; i < c->n; i++) sum += c->a[V][i] * c->a[p][i] * c->a[q][i];
    return sum;
}
static double energy(const cloud *c, int first) { return 0.5 * (product(c, first, first) + product(c, first + 1, first + 1)); }
static void open_cloud(cloud *c, int side, double jitter)
{
    const double dx = 2.0 / side, reach = sph_kernel_support(KERNEL, CLEANING_ETA * dx);
    const size_t n = (size_t)side * (size_t)side;
    pcg32 random;
    sph_index i;
    int k;
    memset(c, 0, sizeof *c);
    c->n = (sph_index)n;
    c->h = CLEANING_ETA * dx;
    c->x[0] = (double *)need_zeros((ARRAYS + 3) * n, sizeof(double));
    c->x[1] = c->x[0] + n;
    c->rho = c->x[1] + n;
    for (k = 0; k < ARRAYS; k++) c->a[k] = c->rho + (size_t)(1 + k) * n;
    pcg32_seed(&random, 7, 1);
    for (i = 0; i < c->n; i++) {
        double s4;
        c->x[0][i] = (i % side + 0.5 + 2 * jitter * (pcg32_uniform(&random) - 0.5)) * dx;
        c->x[1][i] = (i / side + 0.5 + 2 * jitter * (pcg32_uniform(&random) - 0.5)) * dx;
        s4 = 64 * pow(pow(c->x[0][i] - 1, 2) + pow(c->x[1][i] - 1, 2), 2); /* (r/r0)^4, r0 = 1/sqrt(8) */
        c->a[BX][i] = s4 < 1 ? (s4 - 1) * (s4 - 1) / sqrt(4 * MATH_PI) : 0;
    }
    search_all(&c->near, 2, cloud_of(c).points, sph_scalars_same(&reach), SPH_GATHER);
    expect_all(sph_density_summation(KERNEL, 2, cloud_of(c), medium(c).m, sph_scalar_out_array(c->rho, NULL)));
    for (i = 0; i < c->n; i++) c->a[V][i] = 4.0 / c->n / c->rho[i];
}
static void close_cloud(cloud *c)
{
    free(c->x[0]);
    search_close(&c->near);
}

/* B' = B - G phi, or with the corrected gradient, which is exact for a linear phi */
static void subtract(cloud *c, int corrected)
{
    sph_index i;
    if (corrected) {
        const sph_derivatives_out to = {.gx = c->a[GX], .gy = c->a[GY]};
        expect_all(sph_gradient_cspm(KERNEL, 2, cloud_of(c), field(c, PHI), to));
    } else sweep(c, ZERO, PHI, GX, 1, 0); /* -G phi */
    for (i = 0; i < c->n; i++) {
        c->a[BX][i] += (corrected ? -1 : 1) * c->a[GX][i];
        c->a[BY][i] += (corrected ? -1 : 1) * c->a[GY][i];
    }
}
/* D G phi = D B by conjugate gradients for -D G, which is not negative; how many steps */
static int project(cloud *c, double tolerance)
{
    double **const a = c->a;
    double square, first;
    sph_index i;
    int steps = 0;
    sweep(c, BX, ZERO, NONE_X, 1, 0);
    for (i = 0; i < c->n; i++) {
        a[PHI][i] = 0;
        a[RESIDUAL][i] = a[DIRECTION][i] = -a[DIV][i];
    }
    first = square = product(c, RESIDUAL, RESIDUAL);
    while (square > tolerance * tolerance * first && steps < 2000) {
        double length, before = square;
        sweep(c, ZERO, DIRECTION, WX, 1, 0); /* -G d */
        sweep(c, WX, ZERO, NONE_X, 1, 0);    /* -D G d */
        memcpy(a[IMAGE], a[DIV], (size_t)c->n * sizeof(double));
        length = square / product(c, DIRECTION, IMAGE);
        for (i = 0; i < c->n; i++) {
            a[PHI][i] += length * a[DIRECTION][i];
            a[RESIDUAL][i] -= length * a[IMAGE][i];
        }
        square = product(c, RESIDUAL, RESIDUAL);
        for (i = 0; i < c->n; i++) a[DIRECTION][i] = a[RESIDUAL][i] + square / before * a[DIRECTION][i];
        steps++;
    }
    return steps;
}
/* L phi = D B, by rows and GMRES with ILU(0); phi of one particle is 0, as the equations leave a constant open */
static int project_by_rows(cloud *c)
{
    const sph_list list = c->near.found.list;
    double *const row = (double *)need(NULL, (size_t)list.start[c->n], sizeof(double)), *const b = (double *)need(NULL, (size_t)c->n, sizeof(double));
    const sph_rows_out out = {.row = row};
    sparse_builder build;
    sparse A;
    sparse_preconditioner P;
    sparse_options o = sparse_defaults();
    sparse_result result;
    double mean = 0, volume = 0;
    sph_index i, p;
    sweep(c, BX, ZERO, NONE_X, 1, 0);
    expect_all(sph_laplacian_rows_brookshaw(KERNEL, 2, cloud_of(c), out));
    sparse_begin(&build, (int)c->n, list.start[c->n] + c->n);
    for (i = 0; i < c->n; i++) {
        mean += c->a[V][i] * c->a[DIV][i];
        volume += c->a[V][i];
    }
    for (i = 0; i < c->n; i++) {
        double all = 0;
        for (p = list.start[i]; p < list.start[i + 1] && i > 0; p++) {
            all += row[p];
            sparse_put(&build, (int)list.index[p], row[p]);
        }
        sparse_put(&build, (int)i, i > 0 ? -all : 1);
        sparse_end_row(&build);
        b[i] = i > 0 ? c->a[DIV][i] - mean / volume : 0;
        c->a[PHI][i] = 0;
    }
    if (sparse_finish(&build, &A) != 0 || sparse_preconditioner_make(&P, SPARSE_ILU0, &A) != 0) {
        fprintf(stderr, "no matrix, or no preconditioner\n");
        exit(2);
    }
    result = sparse_gmres(&A, &P, b, c->a[PHI], &o);
    if (!result.converged) {
        fprintf(stderr, "%s\n", sparse_status_text(result.status));
        exit(1);
    }
    sparse_preconditioner_free(&P);
    sparse_free(&A);
    free(row);
    free(b);
    return result.iterations;
}
/* root of the mean square: of D B, or of the symmetric form */
static double left_over(cloud *c, int symmetric)
{
    const sph_scalar_out to = sph_scalar_out_array(c->a[DIV], NULL);
    if (symmetric) expect_all(sph_divergence_symmetric(KERNEL, 2, cloud_of(c), medium(c), vectors_of(c->a + BX, 2), to));
    else expect_all(sph_divergence_difference(KERNEL, 2, cloud_of(c), medium(c), vectors_of(c->a + BX, 2), to));
    return sqrt(product(c, DIV, DIV) / 4);
}
/* dB/dt, dpsi/dt by the midpoint rule, until waves have crossed so much; how many steps */
static int clean(cloud *c, double crossed, FILE *data, const char *item)
{
    const double step = 0.3 * c->h, ch = 1, sigma = sph_cleaning_sigma(2), first = left_over(c, 0);
    const int steps = (int)ceil(crossed / step);
    int k, stage;
    sph_index i;
    memset(c->a[PSI], 0, (size_t)c->n * sizeof(double));
    for (k = 0; k < steps; k++) {
        if (k % 10 == 0) fprintf(data, "%s,%.6g,%ld,%.6g\n", item, k * step, c->sweeps, left_over(c, 0) / first);
        for (stage = 0; stage < 2; stage++) {
            double **const a = c->a;
            if (stage == 0) {
                sweep(c, BX, PSI, GX, ch, sigma);
                for (i = 0; i < c->n; i++) {
                    a[WX][i] = a[BX][i] + 0.5 * step * a[GX][i];
                    a[WY][i] = a[BY][i] + 0.5 * step * a[GY][i];
                    a[PHI][i] = a[PSI][i] + 0.5 * step * a[RATE_PSI][i];
                }
            } else {
                sweep(c, WX, PHI, GX, ch, sigma);
                for (i = 0; i < c->n; i++) {
                    a[BX][i] += step * a[GX][i];
                    a[BY][i] += step * a[GY][i];
                    a[PSI][i] += step * a[RATE_PSI][i];
                }
            }
        }
    }
    return steps;
}

enum { EXACT, ROWS, HYPERBOLIC, METHODS };
int main(int argc, char **argv)
{
    static const char *const method[METHODS] = {"exact projection", "approximate projection", "hyperbolic cleaning"};
    const char *out = ".", *figures = ".";
    int full = 0, k, jittered;
    const option_spec specs[] = {{"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
                                 {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
                                 {"full", "100 x 100 particles", OPTION_FLAG, &full, 0, 0}};
    /* the part with divergence of a round peak of Bx: see cleaning_advection */
    const double lost = 0.5 * (1 - 2 * MATH_PI / 8 * pow(4.0 / 15, 2) / (4 * 64.0 / 315));
    static report r;
    FILE *data;
    options_parse(argc, argv, "Divergence cleaning by projection, beside hyperbolic cleaning.", specs, 3);
    report_open(&r, "cleaning_projection", out);
    figure_folder(figures, "cleaning_projection");
    data = figure_open(figures, "cleaning_projection_sweeps");
    fprintf(data, "cloud,crossed,sweeps,left\n");
    for (jittered = 0; jittered < 2; jittered++) {
        const char *const item = jittered ? "jittered" : "lattice";
        long sweeps[METHODS];
        double rest[METHODS], energies[METHODS];
        report_section(&r, item);
        for (k = 0; k < METHODS; k++) {
            const clock_t start = clock();
            double first, first_symmetric, before, after, taken = 0;
            cloud c;
            int steps;
            open_cloud(&c, full ? 100 : 50, jittered ? 0.2 : 0);
            first_symmetric = left_over(&c, 1);
            first = left_over(&c, 0);
            before = energy(&c, BX);
            if (k == EXACT) steps = project(&c, 1e-10);
            else if (k == ROWS) steps = project_by_rows(&c);
            else steps = clean(&c, 3.2, data, item);
            if (k != HYPERBOLIC) {
                subtract(&c, k == ROWS);
                taken = energy(&c, GX);
            }
            after = energy(&c, BX);
            rest[k] = left_over(&c, 0) / first;
            sweeps[k] = c.sweeps;
            report_info(&r, item, method[k], "root of the mean (D B)^2, of the first", rest[k]);
            report_info(&r, item, method[k], "the same of the symmetric form", left_over(&c, 1) / first_symmetric);
            report_info(&r, item, method[k], k == HYPERBOLIC ? "time steps" : "steps of the solver", steps);
            report_info(&r, item, method[k], "sweeps of sph_cleaning_rates", (double)c.sweeps);
            report_info(&r, item, method[k], "CPU time [s]", (double)(clock() - start) / CLOCKS_PER_SEC);
            energies[k] = 1 - after / before;
            if (!jittered) report_relative(report_beside(&r, REPORT_THEORY), item, method[k], "energy lost, of the peak's: the part with divergence", lost, energies[k], 0.01);
            else report_info(&r, item, method[k], "energy lost, of the peak's", energies[k]);
            if (k == EXACT) {
                report_absolute(report_beside(&r, REPORT_THEORY), item, method[k], "root of the mean (D B)^2, of the first", 0, rest[k], 2e-10);
                report_absolute(report_beside(&r, REPORT_THEORY), item, method[k], "|B|^2 - |B'|^2 - |G phi|^2, of |B|^2: the nearest field", 0, (before - after - taken) / before,
                                1e-9);
            }
            if (k == ROWS) report_range(&r, item, method[k], "|B|^2 - |B'|^2 - |grad phi|^2, of |B|^2: not the nearest", (double)NAN, fabs(before - after - taken) / before, 1e-4, 1);
            close_cloud(&c);
        }
        report_range(&r, item, method[ROWS], "root of the mean (D B)^2, of the first: L is not D grad", (double)NAN, rest[ROWS], 1e-2, 1);
        report_absolute(report_beside(&r, REPORT_THEORY), item, "hyperbolic cleaning - exact projection", "energy lost: they end at the same field", 0,
                        energies[HYPERBOLIC] - energies[EXACT], 2e-3);
        report_range(&r, item, "exact projection / hyperbolic cleaning", "sweeps", (double)NAN, (double)sweeps[EXACT] / (double)sweeps[HYPERBOLIC], 0, 2);
    }
    figure_close(data);
    return report_close(&r) ? 1 : 0;
}
