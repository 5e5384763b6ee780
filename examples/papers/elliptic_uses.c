/* SPDX-License-Identifier: MIT
 *
 * elliptic_uses - three things that elliptic operators on particles are for, beyond the elliptic paper: the pressure projection of incompressible SPH,
 * Robin conditions on a curved boundary, and the conduction of heat through a jump of the conductivity. Each has an exact solution.
 *
 * Verdicts other than info go only to what follows from Taylor or Fourier series (see each part); bounds of an error are asserted as 'order at least that,
 * less 0.3', because an order that is observed at three resolutions contains the next term, too.
 *
 *     elliptic_uses [-out DIR] [-figures DIR] [-full]
 */
#include "elliptic_scatter.h"

#include "../common/options.h"
#include "../common/progress.h"
#include "../common/report.h"
#include "../common/statistics.h"

enum { MOST_LEVELS = 4 };
static const double pi = 3.14159265358979323846;
static const double order_slack = 0.3;

/* least-squares order of an error over sizes; at_least > 0: what is derived */
static void report_order(report *r, const char *item, const char *setting, const char *quantity, int levels,
                         const int *size, const double *error, double at_least)
{
    double x[MOST_LEVELS], y[MOST_LEVELS], slope;
    int k;
    for (k = 0; k < levels; k++) {
        x[k] = log(size[k]);
        y[k] = -log(error[k]);
    }
    slope = statistics_slope(x, y, levels);
    if (at_least > 0)
        report_range(r, item, setting, quantity, (double)NAN, slope, at_least - order_slack, HUGE_VAL);
    else report_info(r, item, setting, quantity, slope);
}

/* ================ a. pressure projection ================
 *
 * u* = v + grad phi in a periodic box, v a Taylor-Green vortex (div v = 0) and phi = cos(2 pi x) cos(2 pi y) / (2 pi). One solve of L p = D u*, then
 * u = u* - G p, with the corrected gradient for D and G and M-SPH for L: Chorin 1968, Math. Comput. 22, 745; Cummins & Rudman 1999, J. Comput. Phys. 152, 584.
 *
 * An approximate projection: D G is not L (it would have a wide stencil, blind for checkerboards), so that D u = (1 - D G L^-1) D u* is left. On a lattice all
 * three multiply waves by their symbols: G by i s in x and in y, L by -lambda, and of this field the factor 1 - 2 s^2 / lambda = O(dx^2) is left, which the
 * driver computes from the rows of one particle. D v is 0 there. In disorder L and D G have pointwise errors O(1) that are not the same, and a part of the
 * divergence stays at every resolution and after any number of projections. The velocity is better off, for it sees them through L^-1.
 * Constants are the null space of L. The equation gets an unknown mu added, which takes up what of D u* has no solution, and sum p = 0 besides. */

enum { LATTICE, LATTICE_10, LATTICE_25, STATES };
static const char *const state_name[STATES] = {"lattice", "jitter 10 %", "jitter 25 %"};

static void periodic_lattice(scatter *s, int N, double jitter)
{
    const double dx = 1.0 / N;
    pcg32 g;
    int i, a;
    pcg32_seed(&g, 2020, (uint64_t)N);
    scatter_size(s, 2, N * N);
    s->c.dx = dx;
    s->box[0] = s->box[1] = 1;
    for (i = 0; i < s->c.n; i++) {
        s->c.x[i] = (i % N + 0.5) * dx;
        s->c.y[i] = (i / N + 0.5) * dx;
        for (a = 0; a < 2; a++) cloud_axis(&s->c, a)[i] += jitter * dx * (2 * pcg32_uniform(&g) - 1);
        s->spacing[i] = dx;
    }
    scatter_neighbours(s, 1.2);
    scatter_volumes(s);
}

typedef struct projection {
    scatter *s;
    sparse A; /* n + 1 unknowns */
    sparse_preconditioner P;
    double *b, *p, *gx, *gy, *hx, *hy; /* n + 1 places each */
} projection;

static void gradient_of(const scatter *s, const double *f, double *gx, double *gy)
{
    const sph_derivatives_out out = {.gx = gx, .gy = gy};
    expect(sph_gradient_cspm(ELLIPTIC_KERNEL, 2, scatter_cloud(s), sph_scalars_array(f), out));
}
static void divergence_of(const projection *q, const double *ux, const double *uy, double *out)
{
    int i;
    gradient_of(q->s, ux, q->gx, q->hx);
    gradient_of(q->s, uy, q->hy, q->gy);
    for (i = 0; i < q->s->c.n; i++) out[i] = q->gx[i] + q->gy[i];
}
static void projection_open(projection *q, scatter *s, int scale_traces)
{
    double **const vectors[] = {&q->b, &q->p, &q->gx, &q->gy, &q->hx, &q->hy};
    const int n = s->c.n;
    const double border = 1 / (s->c.dx * s->c.dx); /* the size of the other entries */
    sparse_builder build;
    int i, p;
    size_t v;
    q->s = s;
    for (v = 0; v < sizeof vectors / sizeof *vectors; v++) *vectors[v] = elliptic_vector(n + 1);
    scatter_rows(s, SCHEME_M, scale_traces ? SCATTER_TRACE : SCATTER_PLAIN, 0);
    sparse_begin(&build, n + 1, s->c.lists.start[n] + 3 * (int64_t)n + 1);
    for (i = 0; i < n; i++) {
        sparse_put(&build, i, s->c.diagonal[i]);
        for (p = s->c.lists.start[i]; p < s->c.lists.start[i + 1]; p++)
            sparse_put(&build, s->c.lists.index[p], s->c.row[p]);
        sparse_put(&build, n, border);
        sparse_end_row(&build);
    }
    for (i = 0; i < n; i++) sparse_put(&build, i, border);
    sparse_put(&build, n, 0);
    sparse_end_row(&build);
    elliptic_made(sparse_finish(&build, &q->A), "matrix of the projection");
    elliptic_made(sparse_preconditioner_make(&q->P, SPARSE_ILU0, &q->A),
                  "incomplete factorisation of the projection");
}
static void projection_close(projection *q)
{
    double *const vectors[] = {q->b, q->p, q->gx, q->gy, q->hx, q->hy};
    size_t v;
    for (v = 0; v < sizeof vectors / sizeof *vectors; v++) free(vectors[v]);
    sparse_preconditioner_free(&q->P);
    sparse_free(&q->A);
}
/* u -= G L^-1 D u */
static void project(projection *q, double *ux, double *uy)
{
    sparse_options o = sparse_defaults();
    const int n = q->s->c.n;
    int i;
    o.tolerance = 1e-11;
    o.max_iterations = 4000;
    divergence_of(q, ux, uy, q->b);
    q->b[n] = 0;
    for (i = 0; i <= n; i++) q->p[i] = 0;
    if (!sparse_bicgstab(&q->A, &q->P, q->b, q->p, &o).converged &&
        !sparse_gmres(&q->A, &q->P, q->b, q->p, &o).converged) {
        fprintf(stderr, "elliptic_uses: the pressure did not converge\n");
        exit(1);
    }
    gradient_of(q->s, q->p, q->gx, q->gy);
    for (i = 0; i < n; i++) {
        ux[i] -= q->gx[i];
        uy[i] -= q->gy[i];
    }
}
/* sqrt(sum V (ax - bx)^2 + ...) */
static double distance(const scatter *s, const double *ax, const double *ay, const double *bx,
                       const double *by)
{
    double sum = 0;
    int i;
    for (i = 0; i < s->c.n; i++) {
        const double dx = ax[i] - (bx ? bx[i] : 0), dy = ay ? ay[i] - (by ? by[i] : 0) : 0;
        sum += s->c.V[i] * (dx * dx + dy * dy);
    }
    return sqrt(sum);
}
/* 1 - 2 s^2 / lambda for the wave (2 pi, 2 pi) on a lattice: see above */
static double projection_symbol(const scatter *s)
{
    const sph_vec wave = {2 * pi, 2 * pi, 0};
    const sph_cloud all = scatter_cloud(s);
    double *const wx = elliptic_vector(s->c.lists.start[s->c.n]),
                  *const wy = elliptic_vector(s->c.lists.start[s->c.n]), symbol = 0, re = 0, im = 0;
    int p;
    expect(sph_gradient_rows_cspm(ELLIPTIC_KERNEL, 2, all, (sph_gradient_rows_out){.x = wx, .y = wy}));
    for (p = s->c.lists.start[0]; p < s->c.lists.start[1]; p++) {
        const sph_vec e = scatter_separation(s, 0, s->c.lists.index[p]);
        symbol += wx[p] * sin(wave.x * e.x) * cos(wave.y * e.y);
    }
    expect(sph_rows_growth(2, all, s->c.row, 1, wave, &re, &im)); /* of particle 0: re = 1 - lambda */
    free(wx);
    free(wy);
    return 1 - 2 * symbol * symbol / (1 - re);
}

static void projection_map(const char *folder, const scatter *s, const double *before, const double *after)
{
    FILE *const file = figure_open(folder, "elliptic_uses_projection");
    int i;
    fprintf(file, "x,y,before,after\n");
    for (i = 0; i < s->c.n; i++)
        fprintf(file, "%.6g,%.6g,%.6g,%.6g\n", s->c.x[i], s->c.y[i], before[i], after[i]);
    figure_close(file);
}

static void projections(report *r, const char *folder, scatter *s, int levels)
{
    static const int sides[MOST_LEVELS] = {20, 40, 80, 160};
    int state, scaled, k, i;
    report_section(r, "Pressure projection: Taylor-Green + grad phi in a periodic box");
    for (state = 0; state < STATES; state++)
        for (scaled = 0; scaled < (state == LATTICE ? 1 : 2); scaled++) {
            double left[MOST_LEVELS], velocity[MOST_LEVELS], change[MOST_LEVELS];
            char setting[64];
            for (k = 0; k < levels; k++) {
                projection q;
                double *v[6], norm, before, twice;
                periodic_lattice(s, sides[k], state == LATTICE ? 0 : state == LATTICE_10 ? 0.1 : 0.25);
                projection_open(&q, s, scaled);
                for (i = 0; i < 6; i++)
                    v[i] = elliptic_vector(s->c.n); /* vortex, velocity, divergence before and after */
                for (i = 0; i < s->c.n; i++) {
                    const double x = 2 * pi * s->c.x[i], y = 2 * pi * s->c.y[i];
                    v[0][i] = sin(x) * cos(y);
                    v[1][i] = -cos(x) * sin(y);
                    v[2][i] = v[0][i] - sin(x) * cos(y);
                    v[3][i] = v[1][i] - cos(x) * sin(y);
                }
                norm = distance(s, v[0], v[1], NULL, NULL);
                snprintf(setting, sizeof setting, "%s, %s, N = %d", state_name[state],
                         scaled ? "M / trace" : "M", sides[k]);
                divergence_of(&q, v[2], v[3], v[4]);
                before = distance(s, v[4], NULL, NULL, NULL);
                report_info(r, "projection", setting, "divergence before (exact 2 pi)", before);
                project(&q, v[2], v[3]);
                divergence_of(&q, v[2], v[3], v[5]);
                left[k] = distance(s, v[5], NULL, NULL, NULL) / before;
                velocity[k] = distance(s, v[2], v[3], v[0], v[1]) / norm;
                if (state == LATTICE)
                    report_relative(report_beside(r, REPORT_THEORY), "projection", setting, "divergence after / before",
                                    fabs(projection_symbol(s)), left[k], 1e-6);
                else report_info(r, "projection", setting, "divergence after / before", left[k]);
                report_info(r, "projection", setting, "|u - v| / |v|", velocity[k]);
                report_info(r, "projection", setting, "mu / divergence before",
                            fabs(q.p[s->c.n]) / (s->c.dx * s->c.dx) / before);
                if (state == LATTICE_25 && !scaled && k == 1) projection_map(folder, s, v[4], v[5]);
                project(&q, v[2], v[3]);
                divergence_of(&q, v[2], v[3], v[5]);
                twice = distance(s, v[5], NULL, NULL, NULL) / before;
                if (state == LATTICE)
                    report_relative(report_beside(r, REPORT_THEORY), "projection", setting, "projected twice", pow(projection_symbol(s), 2),
                                    twice, 1e-4);
                else report_info(r, "projection", setting, "projected twice", twice);
                for (i = 0; i < s->c.n; i++) {
                    v[2][i] = v[0][i];
                    v[3][i] = v[1][i];
                }
                project(&q, v[2], v[3]);
                change[k] = distance(s, v[2], v[3], v[0], v[1]) / norm;
                if (state == LATTICE)
                    report_range(r, "projection", setting, "vortex alone: |change| / |v|", (double)NAN,
                                 change[k], 0, 1e-10);
                else report_info(r, "projection", setting, "vortex alone: |change| / |v|", change[k]);
                for (i = 0; i < 6; i++) free(v[i]);
                projection_close(&q);
            }
            snprintf(setting, sizeof setting, "%s, %s, order", state_name[state], scaled ? "M / trace" : "M");
            report_order(r, "projection", setting, "divergence after / before", levels, sides, left,
                         state == LATTICE ? 2 : 0);
            report_order(r, "projection", setting, "|u - v|", levels, sides, velocity,
                         state == LATTICE ? 2 : 0);
            if (state != LATTICE)
                report_order(r, "projection", setting, "vortex alone: |change|", levels, sides, change, 0);
        }
}

/* ================ b. Robin conditions on a circle ================
 *
 * div grad u = s in the unit disc, u + du/dn = g on its rim, u = r^2 cos(2 theta) + sin(2 x + y). Particles on a lattice cut by the circle, or on rings; on
 * the rim a ring of their own, with radial normals. M-SPH's rows next to the rim have errors O(1) in a layer dx thick, the rim's rows O(dx): order 1. In the
 * cut lattice the rest has O(dx^2); rings are disordered, in a way.
 * For comparison rows of weighted least squares (exact for quadratic fields), for the operator and for the normal derivative: O(dx) in disorder, O(dx^2) on
 * the rim. h is 1.6 dx there, because six unknowns want more neighbours. They promise no signs. */

enum { CUT, RINGS, DISCS };
static const char *const disc_name[DISCS] = {"cut lattice", "rings"};
enum { DISC_M, DISC_M_TRACE, DISC_WLS, DISC_METHODS };
static const char *const disc_method[DISC_METHODS] = {"M", "M / trace", "least squares"};

static double disc_solution(double x, double y) { return x * x - y * y + sin(2 * x + y); }
static double disc_source(double x, double y) { return -5 * sin(2 * x + y); }
static double disc_rim(double x, double y)
{
    return disc_solution(x, y) + x * (2 * x + 2 * cos(2 * x + y)) + y * (-2 * y + cos(2 * x + y));
}

static void disc_put(scatter *s, int *n, double x, double y)
{
    s->c.x[*n] = x;
    s->c.y[*n] = y;
    ++*n;
}
static void disc_cloud(scatter *s, int kind, int N)
{
    const double dx = 1.0 / N;
    const int rim = (int)floor(2 * pi / dx + 0.5);
    int n = 0, i, j, k;
    scatter_size(s, 2, 4 * N * N + 8 * N + 8);
    s->c.dx = dx;
    if (kind == CUT) {
        for (j = -N; j <= N; j++)
            for (i = -N; i <= N; i++)
                if (i * i + j * j < (N - 0.5) * (N - 0.5)) disc_put(s, &n, i * dx, j * dx);
    } else {
        disc_put(s, &n, 0, 0);
        for (k = 1; k < N; k++) {
            const int count = (int)floor(2 * pi * k + 0.5);
            for (i = 0; i < count; i++)
                disc_put(s, &n, k * dx * cos(2 * pi * i / count + 2.4 * k),
                         k * dx * sin(2 * pi * i / count + 2.4 * k));
        }
    }
    s->inner = n;
    for (i = 0; i < rim; i++) disc_put(s, &n, cos(2 * pi * i / rim), sin(2 * pi * i / rim));
    s->c.n = n;
    for (i = 0; i < n; i++) s->spacing[i] = dx;
}
static void disc_rows(scatter *s, int method, double *b)
{
    cloud *const c = &s->c;
    int i;
    scatter_neighbours(s, method == DISC_WLS ? 1.6 : 1.2);
    scatter_volumes(s);
    if (method != DISC_WLS) {
        double *const zero = elliptic_vector(c->n), *const one = elliptic_vector(c->n),
                      *const normal[3] = {c->x, c->y, zero};
        for (i = 0; i < c->n; i++) one[i] = 1;
        scatter_rows(s, SCHEME_M, method == DISC_M_TRACE ? SCATTER_TRACE : SCATTER_PLAIN, 0);
        scatter_conditions(s, s->inner, normal, one, one);
        free(zero);
        free(one);
    } else {
        const sph_cloud all = scatter_cloud(s);
        sph_rows_out out = {0};
        out.row = c->row;
        out.diagonal = c->diagonal;
        out.factor = elliptic_vector(c->n);
        expect(sph_derivatives_rows_wls(ELLIPTIC_KERNEL, 2, sph_cloud_range(all, 0, s->inner),
                                        sph_jet_laplacian(2), out));
        for (i = s->inner; i < c->n; i++) { /* every rim particle has a derivative of its own */
            sph_jet d = sph_jet_laplacian(2);
            d.hessian.xx = d.hessian.yy = 0;
            d.gradient.x = c->x[i];
            d.gradient.y = c->y[i];
            expect(sph_derivatives_rows_wls(ELLIPTIC_KERNEL, 2, sph_cloud_range(all, i, i + 1), d, out));
            c->diagonal[i] += out.factor[i];
        }
        for (i = 0; i < c->n; i++) b[i] *= out.factor[i];
        free(out.factor);
    }
}

static void disc(report *r, const char *folder, scatter *s, int levels)
{
    static const int sides[MOST_LEVELS] = {10, 20, 40, 80};
    double *drawn[DISC_METHODS] = {NULL, NULL, NULL};
    int kind, method, k, i;
    report_section(r, "Robin conditions on a circle");
    for (kind = 0; kind < DISCS; kind++)
        for (method = 0; method < DISC_METHODS; method++) {
            double error[MOST_LEVELS];
            char setting[64];
            for (k = 0; k < levels; k++) {
                double *b, *exact;
                sparse A;
                disc_cloud(s, kind, sides[k]);
                b = elliptic_vector(s->c.n);
                exact = elliptic_vector(s->c.n);
                for (i = 0; i < s->c.n; i++) {
                    const double x = s->c.x[i], y = s->c.y[i];
                    exact[i] = disc_solution(x, y);
                    b[i] = i < s->inner ? disc_source(x, y) : disc_rim(x, y);
                }
                disc_rows(s, method, b);
                cloud_matrix(&s->c, &A, b);
                elliptic_solve(&A, b, s->c.u);
                s->inner = s->c.n; /* the rim is unknown, too */
                error[k] = scatter_error(s, s->c.u, exact);
                sparse_free(&A);
                snprintf(setting, sizeof setting, "%s, %s, dx = 1/%d", disc_name[kind], disc_method[method],
                         sides[k]);
                report_info(r, "disc", setting, "relative L2 error", error[k]);
                if (kind == CUT && k == 1) {
                    drawn[method] = elliptic_vector(s->c.n);
                    for (i = 0; i < s->c.n; i++) drawn[method][i] = s->c.u[i];
                }
                free(b);
                free(exact);
            }
            snprintf(setting, sizeof setting, "%s, %s, least squares", disc_name[kind], disc_method[method]);
            report_order(r, "disc", setting, "order", levels, sides, error,
                         kind == CUT || method == DISC_WLS ? 1 : 0);
        }
    {
        FILE *const file = figure_open(folder, "elliptic_uses_disc");
        disc_cloud(s, CUT, sides[1]);
        fprintf(file, "x,y,exact,msph,wls\n");
        for (i = 0; i < s->c.n; i++)
            fprintf(file, "%.6g,%.6g,%.8g,%.8g,%.8g\n", s->c.x[i], s->c.y[i],
                    disc_solution(s->c.x[i], s->c.y[i]), drawn[DISC_M][i], drawn[DISC_WLS][i]);
        figure_close(file);
    }
    for (method = 0; method < DISC_METHODS; method++) free(drawn[method]);
}

/* ================ c. heat through a jump of the conductivity ================
 *
 * du/dt = div(k grad u), k = ratio for x < 0 and 1 for x > 0, u = 1 and 0 there at t = 0. The solution is two error functions that meet in
 * u0 = e_left / (e_left + e_right), e = sqrt(k); Carslaw & Jaeger 1959, Conduction of Heat in Solids, section 2.15. Steps from this at t = 0.01 to t = 0.04 on
 * -1 <= x <= 1, with its values at both ends; a strip of 8 particles, periodic in y, the jump half way between two columns of them.
 *
 * Space: with neighbours on the axes only (h = 0.5005 dx) the harmonic mean is the flux of two half cells in series, which a kink passes exactly: order 2. The
 * arithmetic one leaves out the resistance dx (k_1 - k_2)^2 / (2 k_1 k_2 (k_1 + k_2)), about half a spacing of the poor conductor: order 1, for any ratio. With
 * more neighbours (h = 1.2 dx) the jump is not in the middle of most pairs: order 1 for both; with harmonic means dx has so small a factor that the order
 * observed says nothing yet.
 * Time: explicit with the longest step, dt = O(dx^2); implicit Euler and Crank-Nicolson with N steps, errors O(dx) and O(dx^2).
 * sph_rows_time_step bounds eigenvalues by Gershgorin's circles, and that is sharp for neighbours on the axes: the checkerboard has just this eigenvalue. With
 * diagonal neighbours it is not, and the growth factor of the worst wave gives the step that is. */

enum { AXES, WIDE, WIDE_JITTER, STENCILS };
static const char *const stencil_name[STENCILS] = {"h = 0.5005 dx", "h = 1.2 dx", "h = 1.2 dx, jitter 10 %"};
enum { EXPLICIT, EULER, CRANK_NICOLSON, STEPPINGS };
static const char *const stepping_name[STEPPINGS] = {"explicit", "implicit Euler", "Crank-Nicolson"};
static const char *const mean_name[2] = {"arithmetic", "harmonic"};
enum { SLAB_ROWS = 8 };
static const double slab_begin = 0.01, slab_end = 0.04;

static double slab_exact(double ratio, double x, double t)
{
    const double e = sqrt(ratio), u0 = e / (e + 1);
    return x < 0 ? u0 - (1 - u0) * erf(x / (2 * sqrt(ratio * t))) : u0 * (1 - erf(x / (2 * sqrt(t))));
}

/* N + 1 columns, N odd, the first and the last on the ends and stored last; rows in s->c.row */
static void slab_cloud(scatter *s, int N, int stencil, int mean, double ratio)
{
    const double dx = 2.0 / N;
    pcg32 g;
    int i;
    pcg32_seed(&g, 2020, (uint64_t)N);
    scatter_size(s, 2, SLAB_ROWS * (N + 1));
    s->c.dx = dx;
    s->box[1] = SLAB_ROWS * dx;
    s->inner = SLAB_ROWS * (N - 1);
    for (i = 0; i < s->c.n; i++) {
        const int column = i / SLAB_ROWS, end = i >= s->inner;
        s->c.x[i] = !end ? -1 + (column + 1) * dx : column == N - 1 ? -1 : 1;
        s->c.y[i] = (i % SLAB_ROWS + 0.5) * dx;
        if (stencil == WIDE_JITTER && !end) {
            s->c.x[i] += 0.1 * dx * (2 * pcg32_uniform(&g) - 1);
            s->c.y[i] += 0.1 * dx * (2 * pcg32_uniform(&g) - 1);
        }
        s->c.m[i] = s->c.x[i] < 0 ? ratio : 1;
        s->c.V[i] = dx * dx;
        s->spacing[i] = dx;
    }
    scatter_neighbours(s, stencil == AXES ? 0.5005 : 1.2);
    if (stencil == WIDE_JITTER) scatter_volumes(s);
    scatter_rows(s, SCHEME_M, SCATTER_PLAIN, mean);
}

/* The matrix of 1 - dt (the rows) inside and 1 at the ends; dt = -1 and one = 0: of the rows themselves and 0. Not scaled. */
static void slab_matrix(const scatter *s, double one, double dt, sparse *A)
{
    sparse_builder build;
    int i, p;
    sparse_begin(&build, s->c.n, s->c.lists.start[s->c.n] + s->c.n);
    for (i = 0; i < s->c.n; i++) {
        sparse_put(&build, i, i < s->inner ? one - dt * s->c.diagonal[i] : one);
        for (p = s->c.lists.start[i]; p < s->c.lists.start[i + 1] && i < s->inner; p++)
            if (s->c.row[p] != 0) sparse_put(&build, s->c.lists.index[p], -dt * s->c.row[p]);
        sparse_end_row(&build);
    }
    elliptic_made(sparse_finish(&build, A), "matrix of the slab");
}

static void slab_ends(const scatter *s, double ratio, double t, double *u)
{
    const double left = slab_exact(ratio, -1, t), right = slab_exact(ratio, 1, t);
    int i;
    for (i = s->inner; i < s->c.n; i++) u[i] = s->c.x[i] < 0 ? left : right;
}

/* s->c.u from `begin` on, `count` steps of dt */
static void slab_explicit(scatter *s, double ratio, double begin, double dt, int count)
{
    double *const rate = elliptic_vector(s->c.n), *const u = s->c.u;
    sparse L;
    int step, i;
    slab_matrix(s, 0, -1, &L);
    for (step = 1; step <= count; step++) {
        sparse_multiply(&L, u, rate);
        for (i = 0; i < s->inner; i++) u[i] += dt * rate[i];
        slab_ends(s, ratio, begin + step * dt, u);
    }
    sparse_free(&L);
    free(rate);
}
/* theta = 1 implicit Euler, 1/2 Crank-Nicolson */
static void slab_implicit(scatter *s, double ratio, double theta, int count)
{
    const double dt = (slab_end - slab_begin) / count;
    double *const b = elliptic_vector(s->c.n), *const u = s->c.u;
    sparse_options o = sparse_defaults();
    sparse_preconditioner P;
    sparse L, A;
    int step, i;
    o.tolerance = 1e-11;
    slab_matrix(s, 0, -1, &L);
    slab_matrix(s, 1, theta * dt, &A);
    elliptic_made(sparse_preconditioner_make(&P, SPARSE_ILU0, &A), "incomplete factorisation of the slab");
    for (step = 1; step <= count; step++) {
        sparse_multiply(&L, u, b);
        for (i = 0; i < s->inner; i++) b[i] = u[i] + (1 - theta) * dt * b[i];
        slab_ends(s, ratio, slab_begin + step * dt, b);
        slab_ends(s, ratio, slab_begin + step * dt, u);
        if (!sparse_bicgstab(&A, &P, b, u, &o).converged && !sparse_gmres(&A, &P, b, u, &o).converged) {
            fprintf(stderr, "elliptic_uses: a step did not converge\n");
            exit(1);
        }
    }
    sparse_preconditioner_free(&P);
    sparse_free(&L);
    sparse_free(&A);
    free(b);
}
static double slab_time_step(const scatter *s)
{
    double dt;
    expect(sph_rows_time_step(sph_cloud_range(scatter_cloud(s), 0, s->inner), s->c.row, &dt));
    return dt;
}
static void slab_start(scatter *s, double ratio)
{
    int i;
    for (i = 0; i < s->c.n; i++) s->c.u[i] = slab_exact(ratio, s->c.x[i], slab_begin);
}
static double slab_error(const scatter *s, double ratio)
{
    double *const exact = elliptic_vector(s->c.n), error;
    int i;
    for (i = 0; i < s->c.n; i++) exact[i] = slab_exact(ratio, s->c.x[i], slab_end);
    error = scatter_error(s, s->c.u, exact);
    free(exact);
    return error;
}

/* The longest stable step of the worst wave at a particle of the good conductor, far from the jump and the ends */
static double slab_sharp_step(const scatter *s, int N)
{
    const int i = SLAB_ROWS * (N / 4), waves = 16;
    const sph_cloud target = sph_cloud_range(scatter_cloud(s), i, i + 1);
    double worst = 0, re = 0, im = 0;
    int a, b;
    for (a = 0; a <= waves; a++)
        for (b = 0; b <= waves; b++) {
            const sph_vec wave = {pi / s->c.dx * a / waves, pi / s->c.dx * b / waves, 0};
            expect(sph_rows_growth(2, target, s->c.row, 1, wave, &re, &im));
            worst = fmax(worst, 1 - re);
        }
    return 2 / worst;
}
/* largest |u| after 400 steps, from noise of 1e-6 upon the exact solution */
static double slab_largest(scatter *s, double ratio, double dt)
{
    double largest = 0;
    pcg32 g;
    int i;
    pcg32_seed(&g, 2020, 1);
    slab_start(s, ratio);
    for (i = 0; i < s->inner; i++) s->c.u[i] += 1e-6 * (2 * pcg32_uniform(&g) - 1);
    slab_explicit(s, ratio, slab_begin, dt, 400);
    for (i = 0; i < s->c.n; i++) largest = fmax(largest, fabs(s->c.u[i]));
    return largest;
}
static void slab_limits(report *r, scatter *s)
{
    enum { N = 41 };
    static const double ratios[2] = {10, 1000};
    int stencil, k;
    report_section(r, "Heat: the longest explicit step");
    for (k = 0; k < 2; k++)
        for (stencil = AXES; stencil <= WIDE; stencil++) {
            char setting[64];
            double bound, sharp;
            slab_cloud(s, N, stencil, 1, ratios[k]);
            bound = slab_time_step(s);
            sharp = slab_sharp_step(s, N);
            snprintf(setting, sizeof setting, "ratio %g, %s", ratios[k], stencil_name[stencil]);
            report_info(r, "limit", setting, "sph_rows_time_step / (dx^2 / 4 k)",
                        bound * 4 * ratios[k] / (s->c.dx * s->c.dx));
            if (stencil == AXES)
                report_relative(report_beside(r, REPORT_THEORY), "limit", setting, "worst wave's step / sph_rows_time_step", 1,
                                sharp / bound, 1e-9);
            else
                report_range(r, "limit", setting, "worst wave's step / sph_rows_time_step", (double)NAN,
                             sharp / bound, 1, HUGE_VAL);
            report_range(r, "limit", setting, "largest |u|, 400 steps of 1.0 sph_rows_time_step", (double)NAN,
                         slab_largest(s, ratios[k], bound), 0, 2);
            report_range(r, "limit", setting, "largest |u|, 400 steps of 0.99 of the worst wave's",
                         (double)NAN, slab_largest(s, ratios[k], 0.99 * sharp), 0, 2);
            /* 1 - 1.1 * 2 = -1.2 per step: 1e-6 * 1.2^400 = 5e25 */
            report_range(r, "limit", setting, "largest |u|, 400 steps of 1.1 of the worst wave's",
                         (double)NAN, slab_largest(s, ratios[k], 1.1 * sharp), 1e6, HUGE_VAL);
        }
}

static void slab(report *r, scatter *s, int full, progress *bar)
{
    static const int sides[MOST_LEVELS] = {21, 41, 81, 161};
    static const double ratios[2] = {10, 1000};
    const int levels = 3 + full;
    int q, stencil, mean, stepping, k;
    report_section(r, "Heat through a jump of the conductivity");
    for (q = 0; q < 2; q++)
        for (stencil = 0; stencil < STENCILS; stencil++)
            for (mean = 0; mean < 2; mean++)
                for (stepping = 0; stepping < STEPPINGS; stepping++) {
                    /* explicit steps are 1000 times as many as the poor conductor needs */
                    const int used = stepping == EXPLICIT ? levels - (q == 0 ? 0 : 1) : levels;
                    const double order = stencil == WIDE_JITTER || (stencil == WIDE && mean == 1) ? 0
                                         : stencil == AXES && mean == 1 && stepping != EULER      ? 2
                                                                                                  : 1;
                    double error[MOST_LEVELS];
                    char setting[96];
                    for (k = 0; k < used; k++) {
                        slab_cloud(s, sides[k], stencil, mean, ratios[q]);
                        slab_start(s, ratios[q]);
                        if (stepping == EXPLICIT) {
                            const int count = (int)ceil((slab_end - slab_begin) / slab_time_step(s));
                            slab_explicit(s, ratios[q], slab_begin, (slab_end - slab_begin) / count, count);
                        } else slab_implicit(s, ratios[q], stepping == EULER ? 1 : 0.5, sides[k]);
                        error[k] = slab_error(s, ratios[q]);
                        snprintf(setting, sizeof setting, "ratio %g, %s, %s, %s, N = %d", ratios[q],
                                 stencil_name[stencil], mean_name[mean], stepping_name[stepping], sides[k]);
                        report_info(r, "slab", setting, "relative L2 error", error[k]);
                    }
                    snprintf(setting, sizeof setting, "ratio %g, %s, %s, %s", ratios[q],
                             stencil_name[stencil], mean_name[mean], stepping_name[stepping]);
                    report_order(r, "slab", setting, "order", used, sides, error, order);
                    progress_update(
                        bar, (stepping + 1.0 + STEPPINGS * (mean + 2.0 * (stencil + (double)STENCILS * q))) /
                                 (2 * STENCILS * 2 * STEPPINGS));
                }
}
static void slab_figure(const char *folder, scatter *s)
{
    enum { N = 21 };
    static const double ratios[2] = {10, 1000};
    FILE *const file = figure_open(folder, "elliptic_uses_slab");
    double u[2][N + 1];
    int q, mean, k;
    fprintf(file, "ratio,x,exact,arithmetic,harmonic\n");
    for (q = 0; q < 2; q++) {
        for (mean = 0; mean < 2; mean++) {
            slab_cloud(s, N, AXES, mean, ratios[q]);
            slab_start(s, ratios[q]);
            slab_implicit(
                s, ratios[q], 1,
                200); /* Crank-Nicolson keeps ringing at the jump with arithmetic means: they do not fit the exact beginning */
            for (k = 0; k <= N; k++)
                u[mean][k] = s->c.u[k == 0 ? s->inner : k == N ? s->inner + SLAB_ROWS : SLAB_ROWS * (k - 1)];
        }
        for (k = 0; k <= N; k++) {
            const double x = -1 + 2.0 * k / N;
            fprintf(file, "%g,%.6g,%.8g,%.8g,%.8g\n", ratios[q], x, slab_exact(ratios[q], x, slab_end),
                    u[0][k], u[1][k]);
        }
    }
    figure_close(file);
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0, quiet = 0;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "one finer cloud each", OPTION_FLAG, &full, 0, 0},
        {"quiet", "no progress line", OPTION_FLAG, &quiet, 0, 0},
    };
    static report r;
    scatter s = {0};
    progress bar;
    options_parse(argc, argv,
                  "Uses of the elliptic operator: pressure projection, Robin conditions on a circle, heat "
                  "through a jump of the conductivity.",
                  specs, 4);
    report_open(&r, "elliptic_uses", out);
    figure_folder(figures, "elliptic_uses");
    projections(&r, figures, &s, 3 + full);
    disc(&r, figures, &s, 3 + full);
    slab_limits(&r, &s);
    progress_begin(&bar, "slab", quiet);
    slab(&r, &s, full, &bar);
    progress_end(&bar);
    slab_figure(figures, &s);
    scatter_close(&s);
    return report_close(&r) ? 1 : 0;
}
