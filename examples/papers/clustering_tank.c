/* SPDX-License-Identifier: MIT
 *
 * clustering_tank.c - section V.II of the paper on particle clustering: the pressure of a column of water at rest; table 1 and figure 5.
 *
 *     cc -O2 -o clustering_tank examples/papers/clustering_tank.c -lm
 *     clustering_tank -out DIR -figures DIR [-full]       (-h for help)
 *
 * Column of 1 m, periodic in x: 115 rows of 8 particles (9 with h = 2 dref) of a hexagonal lattice, dref = 1/100, heights (j + 1/2) sqrt(3)/2 dref; rho0 = 1000, c = 30, g = 9.81, alpha = 1, to t = 1. Below it rows of ghosts that continue the
 * lattice as far as a support reaches, at rest; their density follows (5.23), as that of the fluid does. All start with the pressure rho0 g (1 - y), the density that belongs to it, and the mass rho V.
 * The error is that of the slope of the least-squares line through the pressures at 0.1 < y < 0.9, against -rho0 g; table 1 is its mean over all steps.
 *
 * The quick run takes steps of 1e-4 instead of the paper's 1e-5: table 1 is the same within 0.01 points, but the pressure waves of figure 5 are damped less (the density, by (5.23), is stepped explicitly).
 *
 * What it must be: the discrete gradient of a linear pressure is G times the true one (G: clustering_lattice), so the pressure balances gravity with 1/G times the slope; and because water is compressed below,
 * its mean weight is 1 + g (1 - 1/2) / c^2 times rho0 g:   error = (1 + 0.5 g / c^2) / G - 1, of which 0.545 points are physics.
 */
#include "../common/statistics.h"
#define FLOW_PERIODIC 1
#define FLOW_FORM(f) FLOW_CONTINUITY
#include "clustering.h"

enum { ROWS = 115 };
static const double gravity = 9.81, water = 1000, sound = 30;

/* ================================================================ a run */

typedef struct tank {
    FILE *curve; /* of figure 5, or null */
    const char *label;
    int64_t steps, late;
    double sum, late_sum, low[2],
        high[2];      /* of the error in %, its range in both halves of the run; late: second half */
    double deviation; /* sum of |p - exact| / (rho0 g 1 m) of the fluid, in % */
    double *y, *p;
    sph_vectors rest;
    double *share, *zero; /* for wall particles by Adami */
    int adami;
} tank;

typedef struct tank_result {
    flow_answer answer;
    double t; /* of the end */
    double mean, late_mean, low[2], high[2], deviation, fastest, microseconds, nearest;
    int64_t collisions;
} tank_result;

static double exact_pressure(double y) { return water * gravity * (1 - y); }

static double slope_error(const flow *f, tank *t)
{
    int i, n = 0;
    for (i = 0; i < f->n_fluid; i++)
        if (f->y[i] > 0.1 && f->y[i] < 0.9) {
            t->y[n] = f->y[i];
            t->p[n++] = f->p[i];
        }
    return 100 * (statistics_slope(t->y, t->p, n) / (-water * gravity) - 1);
}

/* after each step; the pressures are those that moved it */
static void measure(flow *f)
{
    tank *const t = (tank *)f->data;
    const double error = slope_error(f, t), every = 2e-3;
    const int late = f->t > 0.5;
    t->sum += error;
    t->steps++;
    t->late_sum += late ? error : 0;
    t->late += late;
    t->low[late] = fmin(t->low[late], error);
    t->high[late] = fmax(t->high[late], error);
    if (t->curve && floor(f->t / every + 1e-6) > floor((f->t - f->dt) / every + 1e-6))
        fprintf(t->curve, "%s,%.6g,%.6g\n", t->label, f->t, error);
}

/* Adami, Hu & Adams: pressure and velocity of the ghosts from the fluid above them */
static void wall(flow *f)
{
    tank *const t = (tank *)f->data;
    const sph_wall wall_of = {.share = sph_scalars_array(t->share),
                              .rho = sph_scalars_array(f->rho),
                              .p = sph_scalars_array(f->p),
                              .v = flow_velocities(f),
                              .velocity = t->rest,
                              .gravity = {0, -gravity, 0}};
    const sph_wall_out out = {.p = f->p, .v = sph_vector_out_separate(f->vx, f->vy, NULL)};
    const sph_tait state = {.rho0 = water, .c = sound, .gamma = 1};
    int i;
    expect(sph_wall_adami(f->kernel, 2, sph_cloud_range(flow_cloud(f), f->n_fluid, f->n), wall_of, out));
    for (i = f->n_fluid; i < f->n; i++) f->rho[i] = sph_density_tait(f->p[i], state);
}

static tank_result simulate(sph_kernel kernel, double smoothing, double p0, int remedy, int adami,
                            double dref, double dt, double tend, const clustering_options *o,
                            const char *name, FILE *curve, const char *label)
{
    const int rows = dref > 0.00999 && dref < 0.01001 ? ROWS : (int)(1 / (hexagonal * dref)),
              reach = (int)ceil(sph_kernel_support_ratio(kernel) * smoothing / hexagonal);
    int columns = 8; /* more where a support and its skin would reach beyond half the box */
    const double step = hexagonal * dref;
    tank_result r;
    tank t;
    flow f;
    int i, j;
    memset(&t, 0, sizeof t);
    memset(&r, 0, sizeof r);
    flow_open(&f, name, kernel, dref, smoothing * dref);
    while (columns < 2 * (sph_kernel_support_ratio(kernel) * smoothing + f.skin)) columns++;
    f.box_x = columns * dref;
    f.dt = dt;
    f.form = FLOW_CONTINUITY;
    f.alpha = 1;
    f.gravity_y = -gravity;
    f.state[0].rho0 = water;
    f.state[0].c = sound;
    f.state[0].p0 = p0;
    f.remedy = remedy;
    f.quiet = o->quiet;
    f.vtk = o->vtk ? o->out : NULL;
    f.ghosts_evolve = !adami;
    for (j = 0; j < rows; j++)
        for (i = 0; i < columns; i++) flow_add(&f, (i + 0.5 * (j % 2)) * dref, (j + 0.5) * step, 0, 1);
    for (j = -1; j >= -reach; j--)
        for (i = 0; i < columns; i++) flow_add_ghost(&f, (i + 0.5 * (-j % 2)) * dref, (j + 0.5) * step, 0, 1);
    for (i = 0; i < f.n; i++) {
        f.p[i] = p0 + exact_pressure(f.y[i]);
        f.rho[i] = sph_density_tait(f.p[i], f.state[0]);
        f.m[i] = f.rho[i] * hexagonal * dref * dref;
        if (!f.ghost[i]) f.inverse_mass[i] = 1 / f.m[i];
    }
    t.curve = curve;
    t.label = label;
    t.low[0] = t.low[1] = HUGE_VAL;
    t.high[0] = t.high[1] = -HUGE_VAL;
    t.y = (double *)need(NULL, 4 * (size_t)f.n, sizeof(double));
    t.p = t.y + f.n;
    t.share = t.p + f.n;
    t.zero = t.share + f.n;
    for (i = 0; i < f.n; i++) {
        t.share[i] = !f.ghost[i];
        t.zero[i] = 0;
    }
    t.rest = sph_vectors_separate(t.zero, t.zero, t.zero);
    f.data = &t;
    f.after = measure;
    if (adami) f.ghosts = wall;
    r.answer = flow_run(&f, tend);
    if (r.answer == FLOW_INTERRUPTED || p0 <= 0) flow_require(&f, r.answer);
    r.t = f.t;
    r.mean = t.sum / (double)t.steps;
    r.late_mean = t.late ? t.late_sum / (double)t.late : 0;
    for (i = 0; i < 2; i++) {
        r.low[i] = t.low[i];
        r.high[i] = t.high[i];
    }
    for (i = 0; i < f.n_fluid; i++) {
        r.deviation += 100 * fabs(f.p[i] - p0 - exact_pressure(f.y[i])) / (water * gravity) / f.n_fluid;
        r.fastest = fmax(r.fastest, sqrt(f.vx[i] * f.vx[i] + f.vy[i] * f.vy[i]));
    }
    {
        const flow_domain all = {0, 0, 0, 0}; /* distances only */
        r.nearest = flow_measure(&f, FLOW_ALL, 1, all, NULL).least;
    }
    r.collisions = f.collisions;
    r.microseconds = flow_microseconds(&f);
    free(t.y);
    flow_close(&f);
    return r;
}

/* ================================================================ rows */

static double formula(sph_kernel k, double smoothing)
{
    double S, G;
    clustering_lattice(k, smoothing, &S, &G);
    return 100 * ((1 + 0.5 * gravity / (sound * sound)) / G - 1);
}

static void spread(report *r, const char *at, const tank_result *x)
{
    char text[96];
    snprintf(text, sizeof text, "%.3f in [%.2f, %.2f]", x->late_mean, x->low[1], x->high[1]);
    report_row(r, "Figure 5", at, "error, t > .5 [%]: mean in [least, largest]", NULL, text, NULL, NULL,
               REPORT_INFO);
}

/* A background pressure has nothing to hold it at the free surface: that run, with the density that (5.23) gives there, is a result whatever becomes of it. */
static void kernels(report *r, const clustering_options *o, double dt)
{
    const double background = water * sound * sound;
    int p, k;
    report_section(r, "Kernels beside the paper's, h = 1.5 dref");
    for (p = 0; p < 2; p++)
        for (k = 0; k < CLUSTERING_KERNELS; k++) {
            const tank_result x = simulate(clustering_kernels[k], 1.5, p ? background : 0, FLOW_NO_COLLISIONS,
                                           0, 0.01, dt, 1, o, "clustering_tank_kernels", NULL, NULL);
            const double expected = formula(clustering_kernels[k], 1.5);
            char at[96], text[96];
            snprintf(at, sizeof at, "%s, p0 = %s", sph_kernel_name(clustering_kernels[k]),
                     p ? "rho0 c^2" : "0");
            snprintf(text, sizeof text, "%s t = %.3f; fastest %.2g m/s, nearest %.2f dref",
                     x.answer == FLOW_DONE ? "ran to" : "blew up at", x.t, x.fastest, x.nearest);
            report_row(r, "kernel", at, "outcome", NULL, text, NULL, NULL, REPORT_INFO);
            if (x.answer == FLOW_DONE)
                report_number_row(report_beside(r, REPORT_THEORY), "kernel", at, "mean error [%], and by the lattice formula",
                                  p ? (double)NAN : expected, x.mean, NULL, NULL, REPORT_INFO);
            if (x.answer == FLOW_DONE) spread(r, at, &x);
        }
}

int main(int argc, char **argv)
{
    static const struct {
        sph_kernel k;
        double h;
        int remedy;
        double published;
        const char *label, *name;
    } entry[] = {
        {SPH_WENDLAND_C2_1D, 1.5, FLOW_SEQUENTIAL, 1.32, "particle collisions", "clustering_tank_collisions"},
        {SPH_WENDLAND_C2_1D, 1.5, FLOW_NO_COLLISIONS, 1.32, "Wendland kernel (1.1)",
         "clustering_tank_untreated"},
        {SPH_CONVEX, 1.5, FLOW_NO_COLLISIONS, 2.76, "convex kernel (3.9)", "clustering_tank_convex"},
        {SPH_CONVEX, 2, FLOW_NO_COLLISIONS, 1.20, "convex kernel (3.9)", "clustering_tank_convex_h2"}};
    enum { ENTRIES = (int)(sizeof entry / sizeof *entry) };
    clustering_options o = clustering_defaults();
    const option_spec specs[] = {CLUSTERING_OPTIONS(o)};
    tank_result x[ENTRIES];
    static report r;
    part_file curve;
    char text[160];
    double dt, cost = 0;
    int a;
    options_parse(argc, argv,
                  "Section V.II of the paper on particle clustering: the hydrostatic pressure-tank. Without "
                  "-full the time step is 1e-4 instead of 1e-5.",
                  specs, CLUSTERING_OPTION_COUNT);
    report_open(&r, "clustering_tank", o.out);
    dt = clustering_choose(o.dt, o.full ? 1e-5 : 1e-4);
    if (o.kernel) {
        const sph_kernel k = clustering_kernel(&o);
        const double smoothing = clustering_choose(o.h, 1.5);
        x[0] = simulate(k, smoothing, 0, clustering_remedy(&o), 0, clustering_choose(o.dref, 0.01), dt,
                        clustering_choose(o.tend, 1), &o, "clustering_tank_own", NULL, NULL);
        report_info(&r, "own", sph_kernel_name(k), "mean error of the slope [%]", x[0].mean);
        report_info(&r, "own", sph_kernel_name(k), "lattice formula [%]", formula(k, smoothing));
        spread(&r, sph_kernel_name(k), &x[0]);
        report_info(&r, "own", sph_kernel_name(k), "CPU microseconds per particle and step",
                    x[0].microseconds);
        return report_close(&r) ? 1 : 0;
    }

    if (o.full || o.kernels) kernels(&r, &o, clustering_choose(o.dt, 1e-4));
    if (o.kernels) return report_close(&r) ? 1 : 0;
    clustering_figure(&curve, o.figures, "clustering_fig5");
    fprintf(curve.to, "method,t,error\n");
    report_section(&r, "Table 1: error of the pressure gradient [%], mean over the run");
    for (a = 0; a < ENTRIES; a++) {
        char at[96], label[96];
        snprintf(at, sizeof at, "%s, h = %g dref", entry[a].label, entry[a].h);
        snprintf(label, sizeof label, "%s h = %g dref", entry[a].label, entry[a].h);
        if (a == 1 && x[0].collisions == 0)
            x[1] = x[0]; /* the run with collisions, in which none happened, is the run without them, too */
        else
            x[a] = simulate(entry[a].k, entry[a].h, 0, entry[a].remedy, 0, 0.01, dt, 1, &o, entry[a].name,
                            curve.to, label);
        report_absolute(&r, "Table 1", at, "mean error [%]", entry[a].published, x[a].mean, 0.1);
        report_absolute(report_beside(&r, REPORT_THEORY), "Table 1", at, "mean error [%], and by the lattice formula",
                        formula(entry[a].k, entry[a].h), x[a].mean, 0.05);
        spread(&r, at, &x[a]);
        cost += x[a].microseconds / ENTRIES;
    }
    clustering_figure_close(&curve);
    snprintf(text, sizeof text, "0.5 g / c^2 = %.3f points of each entry: water compressed by its weight",
             50 * gravity / (sound * sound));
    report_claim_fails(&r, "Table 1", "all", "'the error we make'", "of the method", text,
                       "that part is physics: the exact slope of the compressible column");

    report_section(&r, "Section V.II: what is said");
    snprintf(text, sizeof text, "[%.2f, %.2f] against [%.2f, %.2f]", x[1].low[1], x[1].high[1], x[2].low[1],
             x[2].high[1]);
    report_claim(&r, "Figure 5", "h = 1.5 dref, t > .5", "fluctuations",
                 "'significantly smaller' with (1.1) than with (3.9)", text, "range is smaller",
                 x[1].high[1] - x[1].low[1] < x[2].high[1] - x[2].low[1]);
    /* the start is an error of 0 and no part of the waves: the first half counts by its largest value */
    snprintf(text, sizeof text, "largest error %.2f %% before t = .5, %.2f %% after, mean %.2f %%",
             x[2].high[0], x[2].high[1], x[2].mean);
    report_claim(&r, "Section V.II", "convex kernel, h = 1.5 dref", "'fluctuations become smaller over time'",
                 "until an equilibrium", text, "smaller in the second half; no equilibrium by t = 1",
                 x[2].high[1] < x[2].high[0]);
    snprintf(text, sizeof text, "%ld collisions; mean %.6f against %.6f %%; nearest pair at %.3f dref",
             (long)x[0].collisions, x[0].mean, x[1].mean, x[0].nearest);
    report_claim(&r, "Section V.II", "particle collisions", "'no influence on the pressures'",
                 "very interesting", text, "no collision happens: nothing is within 0.85 dref",
                 x[0].collisions == 0);
    snprintf(text, sizeof text, "%.3f, %.3f", x[2].mean, x[3].mean);
    report_claim(&r, "Section V.II", "convex kernel, h = 1.5, 2 dref", "error", "smaller for the larger h",
                 text, "smaller", x[3].mean < x[2].mean);

    report_section(&r, "beyond the paper: wall particles by Adami et al. (2012), (1.1), h = 1.5 dref");
    {
        const tank_result w = simulate(SPH_WENDLAND_C2_1D, 1.5, 0, FLOW_NO_COLLISIONS, 1, 0.01, dt, 1, &o,
                                       "clustering_tank_adami", NULL, NULL);
        report_info(&r, "beyond", "Adami's walls", "mean error of the slope [%]", w.mean);
        spread(&r, "Adami's walls", &w);
        report_info(&r, "beyond", "Adami's walls, at the end", "mean |p - exact| / (rho0 g 1 m) [%]",
                    w.deviation);
        report_info(&r, "beyond", "ghosts by (5.23), at the end", "mean |p - exact| / (rho0 g 1 m) [%]",
                    x[1].deviation);
        report_info(&r, "beyond", "Adami's walls, at the end", "fastest particle [m/s]", w.fastest);
        report_info(&r, "beyond", "ghosts by (5.23), at the end", "fastest particle [m/s]", x[1].fastest);
    }
    report_info(&r, "run", "", "CPU microseconds per particle and step", cost);
    return report_close(&r) ? 1 : 0;
}
