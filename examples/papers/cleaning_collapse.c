/* SPDX-License-Identifier: MIT
 *
 * cleaning_collapse.c - section IV-C of the paper on divergence cleaning, figures 4 to 6: the collapse of a magnetised molecular cloud core to a protostar, with and without cleaning.
 *
 *     cc -O2 -o cleaning_collapse examples/papers/cleaning_collapse.c -lm              (-fopenmp: threads)
 *     cleaning_collapse -out DIR -figures DIR [-full] [-particles N] [-continue] ...    (-h for help)
 *
 * A sphere of one solar mass, R = 4e16 cm, rho = 7.43e-18 g/cm^3, in solid-body rotation, in a box of 4 R with a medium of 1/30 of its density and the same pressure; a uniform field along the axis,
 * mass-to-flux ratio 5. Code units: 1e16 cm, one solar mass, G = 1, mu_0 = 1. Unsaid in the paper and chosen here (see the README beside this file): sound speed 2.19e4 cm/s, rotation 1.77e-13 / s,
 * barotropic equation of state above 1e-14 g/cm^3, (M / Phi)_crit = 2/3 0.53 sqrt(5 / pi), cubic spline, alpha in [0.1, 1], beta = 2, alpha_B = 0.1 min(1, h |curl B| / |B|), sigma = 1, gravity isolated.
 * The error is the mean of h |div B| / |B| over the particles; the ratio of means <h |div B|> / <|B|> is more robust. Runs are compared at the same largest density.
 * Ctrl-C leaves a restart of the run that was on its way; so does a run that is killed, from a minute before or less: -continue goes on, to the same numbers, bit for bit.
 */
#ifndef SPH_CHECK
#define SPH_CHECK 0 /* every step looks for what is not finite, and says where */
#endif
#include "../common/vtk.h"
#include "cleaning.h"
#include "collapse.h"
#include "collapse_column.h"

#include <signal.h>

/* ---- units, in cgs ---- */

#define UNIT_LENGTH 1e16
#define UNIT_MASS 1.989e33
#define NEWTON 6.674e-8
#define AU 1.496e13
#define YEAR 3.156e7
static double unit_time(void) { return sqrt(UNIT_LENGTH * UNIT_LENGTH * UNIT_LENGTH / (NEWTON * UNIT_MASS)); }
static double unit_density(void) { return UNIT_MASS / (UNIT_LENGTH * UNIT_LENGTH * UNIT_LENGTH); }
static double unit_gauss(void) { return sqrt(4 * MATH_PI * unit_density()) * UNIT_LENGTH / unit_time(); }

#define RADIUS 4.0
#define BOX 16.0
#define SOUND 0.19
#define CONTRAST 30.0
#define ROTATION 0.01536
static double cloud_density(void) { return 3 / (4 * MATH_PI * RADIUS * RADIUS * RADIUS); }
static double free_fall(void) { return sqrt(3 * MATH_PI / (32 * cloud_density())); }
static double field_of(double mass_to_flux) { return 1 / (MATH_PI * RADIUS * RADIUS * mass_to_flux * (2.0 / 3 * 0.53 * sqrt(5 / MATH_PI))); }

/* ---- the cloud ---- */

/* Face-centred cubic lattice of the sphere, its middle at no place of symmetry, where the forces of (9) would cancel; counts only where p is null */
static int sphere(double spacing, double *const *p)
{
    static const double site[4][3] = {{0.31, 0.17, 0.23}, {0.81, 0.67, 0.23}, {0.81, 0.17, 0.73}, {0.31, 0.67, 0.73}};
    const int side = (int)(RADIUS / spacing) + 2;
    int n = 0, i, j, k, s;
    for (i = -side; i <= side; i++)
        for (j = -side; j <= side; j++)
            for (k = -side; k <= side; k++)
                for (s = 0; s < 4; s++) {
                    const double x = (i + site[s][0]) * spacing, y = (j + site[s][1]) * spacing, z = (k + site[s][2]) * spacing;
                    if (x * x + y * y + z * z >= RADIUS * RADIUS) continue;
                    if (p) {
                        p[0][n] = x;
                        p[1][n] = y;
                        p[2][n] = z;
                    }
                    n++;
                }
    return n;
}
/* Body-centred cubic lattice of the box outside of the sphere, stretched so that the density comes out */
static int surroundings(const int *cells, int first, double *const *p)
{
    int n = first, i, c;
    for (i = 0; i < 2 * cells[0] * cells[1] * cells[2]; i++) {
        const int at[3] = {i / 2 % cells[0], i / 2 / cells[0] % cells[1], i / 2 / cells[0] / cells[1]};
        double x[3], r2 = 0;
        for (c = 0; c < 3; c++) {
            x[c] = BOX * ((at[c] + (i % 2 ? 0.75 : 0.25)) / cells[c] - 0.5);
            r2 += x[c] * x[c];
        }
        if (r2 < RADIUS * RADIUS) continue;
        for (c = 0; c < 3 && p; c++) p[c][n] = x[c];
        n++;
    }
    return n - first;
}
/* Cells along the axes, k or k + 1 each, whose number is nearest to `wanted` */
static void cells_of(double wanted, int *cells)
{
    const int k = (int)cbrt(wanted);
    int extra, best = 0, c;
    double off = HUGE_VAL;
    for (extra = 0; extra <= 3; extra++) {
        const double count = pow(k, 3 - extra) * pow(k + 1, extra);
        if (fabs(count - wanted) < off) {
            off = fabs(count - wanted);
            best = extra;
        }
    }
    for (c = 0; c < 3; c++) cells[c] = k + (c < best);
}

/* About `particles` in the sphere; answers how many. model.m is set. */
static int cloud(collapse *g, collapse_model *model, int particles, double mass_to_flux)
{
    const double spacing = RADIUS * cbrt(16 * MATH_PI / (3.0 * particles));
    const int inside = sphere(spacing, NULL);
    int cells[3], outside, i, c;
    double *p[3], drift[2] = {0, 0};
    model->m = 1.0 / inside;
    cells_of(cloud_density() / CONTRAST * BOX * BOX * BOX / model->m / 2, cells);
    outside = surroundings(cells, 0, NULL);
    collapse_new(g, model, inside + outside);
    for (c = 0; c < 3; c++) p[c] = g->a[X + c];
    sphere(spacing, p);
    surroundings(cells, inside, p);
    for (i = 0; i < inside; i++)
        for (c = 0; c < 2; c++) drift[c] += (c ? ROTATION * p[0][i] : -ROTATION * p[1][i]) / inside;
    for (i = 0; i < inside + outside; i++) {
        const int medium = i >= inside;
        g->a[ID][i] = i;
        g->a[MEDIUM][i] = medium;
        g->a[VX][i] = medium ? 0 : -ROTATION * g->a[Y][i] - drift[0]; /* without momentum, although the lattice has no symmetry */
        g->a[VY][i] = medium ? 0 : ROTATION * g->a[X][i] - drift[1];
        g->a[BZ][i] = field_of(mass_to_flux);
        g->a[ALPHA][i] = model->alpha_min;
        g->a[H][i] = COLLAPSE_ETA * cbrt(model->m / (medium ? cloud_density() / CONTRAST : cloud_density()));
    }
    return inside;
}

/* ---- runs ---- */

static volatile sig_atomic_t interrupted;
static void interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

/* One step's end */
typedef struct sample {
    double t, dt, densest, error, error_cloud, ratio, moved, unexplained, tree, ch, core, field_force;
} sample;
/* What a run leaves behind, besides its pictures; with its samples behind it in a restart */
typedef struct record {
    double momentum[3]; /* at the start */
    int pictures, inside;
    long samples, room;
} record;

typedef struct plan {
    const char *name;
    int cleans, particles, everywhere;
    double alpha_B;    /* resistivity: everywhere, or at most, by its switch */
    double end, after; /* stops at this time, or so long after the sink has formed (code units); the earlier */
    double panel;      /* when to make the picture of figure 4; 0: at the end */
    long cap;          /* of the steps after the sink has formed */
} plan;
typedef struct outcome {
    char name[64], ended[192]; /* why */
    record r;
    sample *at;
    sink core;
    double cpu, fastest_jet, jet_mass;
    long steps;
    int troubled; /* it had to stop */
    sph_index n;
} outcome;

typedef struct setting {
    int full, direct, no_zeta, go_on;
    double theta, courant, mass_to_flux, sink_radius, sigma, vtk, shortest;
    const char *out, *figures;
    progress show;
    double work, done;
} setting;

static void fail(const char *format, const char *text)
{
    fflush(stdout);
    fprintf(stderr, "\ncleaning_collapse: ");
    fprintf(stderr, format, text);
    fputc('\n', stderr);
    exit(3);
}

static collapse_model model_of(const setting *s, const plan *p)
{
    collapse_model m;
    memset(&m, 0, sizeof m);
    m.box = BOX;
    m.cs = SOUND;
    m.medium_cs = SOUND * sqrt(CONTRAST);
    m.rho1 = 1e-14 / unit_density();
    m.rho2 = 1e-10 / unit_density();
    m.courant = s->courant;
    m.shortest = s->shortest;
    m.fastest = 1e5;
    m.theta = s->direct ? 0 : s->theta;
    m.alpha_B = p->alpha_B;
    m.alpha_min = 0.1;
    m.alpha_max = 1;
    m.sigma = s->sigma;
    m.tensile = 1;
    m.radius = s->sink_radius * AU / UNIT_LENGTH;
    m.rho_sink = 1e-10 / unit_density();
    m.cleans = p->cleans;
    m.zeta = !s->no_zeta;
    m.switches = !p->everywhere;
    return m;
}

static void add_sample(outcome *o, const collapse *g, double dt)
{
    double p[3], rest[3];
    sample *x;
    int c;
    if (o->r.samples == o->r.room) {
        o->r.room = 2 * o->r.room + 1024;
        o->at = (sample *)need(o->at, (size_t)o->r.room, sizeof *o->at);
    }
    x = &o->at[o->r.samples++];
    collapse_momentum(g, p);
    for (c = 0; c < 3; c++) {
        p[c] -= o->r.momentum[c];
        rest[c] = p[c] - g->s.impulse_gravity[c] - g->s.impulse_field[c];
    }
    x->t = g->s.t;
    x->dt = dt;
    x->densest = g->s.densest;
    x->error = g->s.error;
    x->error_cloud = g->s.error_cloud;
    x->ratio = g->s.ratio;
    x->moved = collapse_length(p);
    x->unexplained = collapse_length(rest);
    x->tree = collapse_length(g->s.impulse_gravity);
    x->field_force = collapse_length(g->s.force_field);
    x->ch = g->s.ch;
    x->core = g->s.core.m;
}

enum { SIDE = 120, WINDOWS = 2 };
static const double window[WINDOWS] = {0.25, 5}; /* half widths */
/* Along y, about the sink or the densest particle: column density [g/cm^2] and mean velocity along the axis [km/s] */
static void write_columns(const setting *s, const collapse *g, const char *name, const char *moment)
{
    const column_table table = column_table_of(COLLAPSE_KERNEL);
    const size_t pixels = (size_t)SIDE * SIDE;
    double *const pixel = (double *)need_zeros(2 * pixels, sizeof *pixel),
                  *const x = (double *)need_zeros(2 * (size_t)g->s.n, sizeof *x),
                  *const z = x + g->s.n, middle[3] = {g->s.core.x[0], g->s.core.x[1], g->s.core.x[2]};
    char file[128];
    FILE *to;
    sph_index i, densest = 0;
    int w;
    size_t k;
    for (i = 1; i < g->s.n; i++)
        if (g->a[RHO][i] > g->a[RHO][densest]) densest = i;
    if (!(g->s.core.m > 0)) collapse_vector_of(g->a, X, densest, middle);
    for (i = 0; i < g->s.n; i++) {
        x[i] = g->a[X][i] - middle[0];
        z[i] = g->a[Z][i] - middle[2];
    }
    snprintf(file, sizeof file, "cleaning_collapse_fig4_%s%s", name + strlen("cleaning_collapse_"), moment);
    to = figure_open(s->figures, file);
    fprintf(to, "window,t_ff,x,z,column,v_z\n");
    for (w = 0; w < WINDOWS; w++) {
        memset(pixel, 0, 2 * pixels * sizeof *pixel);
        column_add(&table, (int)g->s.n, x, z, g->a[H], g->model.m, NULL, window[w], SIDE, pixel);
        column_add(&table, (int)g->s.n, x, z, g->a[H], g->model.m, g->a[VZ], window[w], SIDE, pixel + pixels);
        for (k = 0; k < pixels; k++)
            fprintf(to, "%g,%.6g,%.6g,%.6g,%.6g,%.6g\n", window[w], g->s.t / free_fall(), ((int)(k % SIDE) + 0.5) * 2 * window[w] / SIDE - window[w],
                    ((int)(k / SIDE) + 0.5) * 2 * window[w] / SIDE - window[w], pixel[k] * unit_density() * UNIT_LENGTH,
                    pixel[k] > 0 ? pixel[pixels + k] / pixel[k] * 1e-5 * UNIT_LENGTH / unit_time() : 0);
    }
    figure_close(to);
    free(pixel);
    free(x);
}
static void write_vtk(vtk_series *series, const collapse *g)
{
    const vtk_field fields[] = {{"velocity", g->a[VX], g->a[VY], g->a[VZ], NULL},
                                {"B", g->a[BX], g->a[BY], g->a[BZ], NULL},
                                {"density", g->a[RHO], NULL, NULL, NULL},
                                {"h", g->a[H], NULL, NULL, NULL},
                                {"psi", g->a[PSI], NULL, NULL, NULL},
                                {"div_B", g->a[DIV_B], NULL, NULL, NULL},
                                {"medium", g->a[MEDIUM], NULL, NULL, NULL},
                                {"id", g->a[ID], NULL, NULL, NULL}};
    if (!vtk_series_add(series, g->s.t, (int)g->s.n, g->a[X], g->a[Y], g->a[Z], fields, 8)) fail("%s cannot be written", "a VTK file");
}

/* The last sample of a run that has ended is left out: it is that of the state that is saved, and comes again, so that a run that is given more time goes on. */
static void save(const setting *s, collapse *g, const outcome *o)
{
    record r = o->r;
    char *more;
    if (o->ended[0]) r.samples--;
    more = (char *)need(NULL, sizeof r + (size_t)o->r.samples * sizeof *o->at, 1);
    memcpy(more, &r, sizeof r);
    memcpy(more + sizeof r, o->at, (size_t)r.samples * sizeof *o->at);
    if (!collapse_save(g, s->out, o->name, more, sizeof r + (size_t)r.samples * sizeof *o->at)) fail("%s", g->trouble);
    free(more);
}
/* 1: the run goes on from its restart. */
static int load(const setting *s, collapse *g, outcome *o)
{
    size_t size;
    void *more;
    const int found = collapse_load(g, s->out, o->name, &more, &size);
    if (found < 0) {
        fprintf(stderr, "cleaning_collapse: %s/%s.restart: %s; remove it, or run without -continue\n", s->out, o->name, g->trouble);
        exit(2);
    }
    if (!found) return 0;
    memcpy(&o->r, more, sizeof o->r);
    o->r.room = o->r.samples;
    o->at = (sample *)need(NULL, (size_t)o->r.room + 1, sizeof *o->at);
    memcpy(o->at, (char *)more + sizeof o->r, (size_t)o->r.samples * sizeof *o->at);
    free(more);
    return 1;
}

/* About as many steps as a run has before its sink, in the time it has after it */
static double share_done(const plan *p, const collapse *g)
{
    const double before = fmin(1, g->s.t / fmin(p->end, 0.92 * free_fall()));
    return g->s.core.m > 0 ? 0.3 + 0.7 * fmin(1, (g->s.t - g->s.core.born) / p->after) : 0.3 * before;
}

static void run(setting *s, const plan *p, outcome *o)
{
    collapse_model model = model_of(s, p);
    collapse g;
    vtk_series series;
    clock_t start = clock();
    time_t saved = time(NULL);
    int k;
    memset(o, 0, sizeof *o);
    o->r.inside = cloud(&g, &model, p->particles, s->mass_to_flux);
    snprintf(o->name, sizeof o->name, "cleaning_collapse_%d_%s", o->r.inside, p->name);
    for (k = 0; o->name[k]; k++)
        if (strchr(" =.-", o->name[k])) o->name[k] = '_';
    vtk_series_begin(&series, s->figures, o->name);
    if (s->go_on && load(s, &g, o)) {
        vtk_series_resume(&series, g.s.t);
        report_cpu_before += g.s.cpu;
    } else {
        collapse_momentum(&g, o->r.momentum);
        if (collapse_rates(&g)) fail("the start: %s", g.trouble);
    }
    while (!o->ended[0] && !interrupted) {
        sph_index shortest;
        double dt = collapse_longest_step(&g, &shortest);
        add_sample(o, &g, dt);
        if (p->panel > 0 && g.s.t >= p->panel && !o->r.pictures) {
            write_columns(s, &g, o->name, "");
            o->r.pictures = 1;
        }
        if (s->vtk > 0 && g.s.t >= s->vtk * series.count * free_fall()) write_vtk(&series, &g);
        if (g.s.t >= p->end) snprintf(o->ended, sizeof o->ended, "its time is over");
        else if (g.s.core.m > 0 && g.s.t >= g.s.core.born + p->after) snprintf(o->ended, sizeof o->ended, "%g t_ff after the sink", p->after / free_fall());
        else if (p->cap > 0 && g.s.core.m > 0 && g.s.steps - g.s.core.born_step >= p->cap)
            snprintf(o->ended, sizeof o->ended, "%ld steps after the sink", p->cap);
        else if (dt < s->shortest) {
            snprintf(o->ended, sizeof o->ended, "time step: particle %ld wants %.3g, less than %.3g", (long)g.a[ID][shortest], dt, s->shortest);
            o->troubled = 1;
        } else if (collapse_step(&g, fmin(dt, p->end - g.s.t))) {
            snprintf(o->ended, sizeof o->ended, "%s", g.trouble);
            o->troubled = 1;
        }
        if (o->troubled)
            fprintf(stderr, "\n%s, t = %g t_ff: %s; the run stops, its last good state is in %s/%s.restart\n", o->name, g.s.t / free_fall(), o->ended, s->out,
                    o->name);
        if (o->ended[0]) {
            if (!o->r.pictures || p->panel <= 0) write_columns(s, &g, o->name, "");
            else if (p->end > p->panel) write_columns(s, &g, o->name, "_end");
            if (s->vtk > 0) write_vtk(&series, &g);
        }
        if (o->ended[0] || interrupted || difftime(time(NULL), saved) >= 30) {
            g.s.cpu += (double)(clock() - start) / CLOCKS_PER_SEC;
            start = clock();
            saved = time(NULL);
            save(s, &g, o);
        }
        progress_update(&s->show, (s->done + share_done(p, &g) * pow(p->particles, 4.0 / 3)) / s->work);
    }
    s->done += pow(p->particles, 4.0 / 3);
    o->core = g.s.core;
    o->cpu = g.s.cpu;
    o->steps = g.s.steps;
    o->n = g.s.n;
    for (k = 0; k < g.s.n; k++) { /* what leaves along the axis, faster than it could without a push: beyond the speed of sound of the cold gas */
        const double z = g.a[Z][k] - g.s.core.x[2], v = g.a[VZ][k] - g.s.core.v[2];
        if (g.a[MEDIUM][k] > 0 || z * v <= 0 || fabs(v) < SOUND || fabs(z) > 1) continue;
        o->jet_mass += g.model.m;
        o->fastest_jet = fmax(o->fastest_jet, fabs(v));
    }
    vtk_series_end(&series);
    collapse_free(&g);
}

/* ---- the table ---- */

/* Where a run first reaches this density before it has a sink, between two steps; 0: it does not */
static int at_density(const outcome *o, double densest, sample *x)
{
    long k;
    for (k = 1; k < o->r.samples && !(o->at[k].core > 0); k++)
        if (o->at[k].densest >= densest && o->at[k - 1].densest < densest) {
            const sample *const a = &o->at[k - 1], *const b = &o->at[k];
            const double f = log(densest / a->densest) / log(b->densest / a->densest);
#define BETWEEN(field) x->field = a->field + f * (b->field - a->field)
            *x = *a;
            BETWEEN(t);
            BETWEEN(error);
            BETWEEN(error_cloud);
            BETWEEN(ratio);
            BETWEEN(moved);
#undef BETWEEN
            return 1;
        }
    return 0;
}
/* The largest of a field of the samples within a length of time after the sink has formed */
#define LARGEST(o, field, length) largest(o, offsetof(sample, field), length)
static double largest(const outcome *o, size_t offset, double length)
{
    double most = 0;
    long k;
    for (k = 0; k < o->r.samples; k++)
        if (o->at[k].core > 0 && o->at[k].t <= o->core.born + length) most = fmax(most, *(const double *)(const void *)((const char *)&o->at[k] + offset));
    return most;
}
static double time_of(const outcome *o, long k) { return o->at[k].t / free_fall(); }
static double after_sink(const outcome *o) { return o->core.m > 0 ? (o->at[o->r.samples - 1].t - o->core.born) / free_fall() : 0; }

static void list_run(report *r, const char *size, const plan *p, const outcome *o)
{
    const sample *const last = &o->at[o->r.samples - 1];
    char text[256];
    double worst = 0, scale = 0;
    long k;
    snprintf(text, sizeof text, "t = %.4f t_ff, %ld steps: %s", last->t / free_fall(), o->steps, o->ended);
    if (p->cleans) report_claim(r, size, p->name, "end of the run", "the protostar remains stable", text, "no trouble", !o->troubled);
    else report_row(r, size, p->name, "end of the run", NULL, text, NULL, NULL, REPORT_INFO); /* trouble is what the paper expects of it */
    if (o->core.m > 0) {
        snprintf(text, sizeof text, "%.4f t_ff, then %.4f t_ff more; mass %.4f of %ld particles, moved (%.4f, %.4f, %.4f), v (%.3f, %.3f, %.3f)",
                 o->core.born / free_fall(), after_sink(o), o->core.m, o->core.swallowed, o->core.x[0], o->core.x[1], o->core.x[2], o->core.v[0], o->core.v[1],
                 o->core.v[2]);
        report_row(r, size, p->name, "sink", NULL, text, NULL, NULL, REPORT_INFO);
        snprintf(text, sizeof text, "%.3g of mass beyond cs along the axis, fastest %.3g cs", o->jet_mass, o->fastest_jet / SOUND);
        report_row(r, size, p->name, "outflow", NULL, text, NULL, NULL, REPORT_INFO);
    }
    snprintf(text, sizeof text, "%.4f (cloud %.4f, ratio of means %.4f), |P - P0| = %.2e, ch = %.3g, dt = %.2e", last->error, last->error_cloud, last->ratio,
             last->moved, last->ch, last->dt);
    report_row(r, size, p->name, "error at the end", NULL, text, NULL, NULL, REPORT_INFO);
    for (k = 0; k < o->r.samples; k++) {
        worst = fmax(worst, o->at[k].unexplained);
        scale = fmax(scale, fmax(o->at[k].moved, o->at[k].tree));
    }
    report_range(report_beside(r, REPORT_THEORY), size, p->name, "momentum that neither (9) nor the tree has made / the largest |P - P0|", 0, worst / scale, 0, 1e-9);
    report_info(r, size, p->name, "momentum by the tree's error, |sum of impulses|", last->tree);
    report_info(r, size, p->name, "CPU time [s]", o->cpu);
    report_info(r, size, p->name, "CPU us per particle-step", 1e6 * o->cpu / ((double)o->steps * o->n));
}

/* The statement holds, or it does not at this resolution */
static void claim(report *r, const char *item, const char *size, const char *quantity, const char *published, const char *measured, int holds,
                  const char *reason)
{
    if (holds) report_claim(r, item, size, quantity, published, measured, "at least as much", 1);
    else report_claim_fails(r, item, size, quantity, published, measured, reason);
}
/* What control / cleaned was in our own runs with alpha_B of at most 0.1 by the switch: how much of what is published about both holds depends on the number of particles. The momenta are
   those of a break-up, which rounding changes. */
static void before(report *r, const char *size, const plan *p, double error, double momentum)
{
    static const struct {
        int particles;
        double error, momentum;
    } known[] = {{2000, 13.3, 230}, {10000, 3.6, 5.1}, {30000, 3.3, 7.6}};
    size_t k;
    if (p->everywhere || fabs(p->alpha_B - 0.1) > 1e-12) return;
    for (k = 0; k < sizeof known / sizeof *known; k++)
        if (known[k].particles == p->particles) {
            if (error > 0) report_factor(report_beside(r, REPORT_REGRESSION), "Figure 5", size, "error before the sink, control / cleaned", known[k].error, error, 1.5);
            if (momentum > 0)
                report_factor(report_beside(r, REPORT_REGRESSION), "Figure 6", size, "momentum made within 5e-4 t_ff, control / cleaned", known[k].momentum, momentum, 5);
        }
}
static void compare(report *r, const char *size, const plan *pa, const outcome *a, const plan *pb, const outcome *b, int asserted)
{
    static const double densities[] = {1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 7e-11};
    const int count = (int)(sizeof densities / sizeof *densities);
    const double tff = free_fall();
    char what[96], text[160];
    sample x, y;
    int k;
    for (k = 0; k < count; k++)
        if (at_density(a, densities[k] / unit_density(), &x) && at_density(b, densities[k] / unit_density(), &y)) {
            snprintf(what, sizeof what, "largest density %g g/cm^3", densities[k]);
            snprintf(text, sizeof text, "%.4f / %.4f = %.2f (cloud %.2f, ratio of means %.2f; |P - P0| %.1e / %.1e)", x.error, y.error, x.error / y.error,
                     x.error_cloud / y.error_cloud, x.ratio / y.ratio, x.moved, y.moved);
            report_row(r, size, what, "error, control / cleaned", NULL, text, NULL, NULL, REPORT_INFO);
        }
    if (at_density(a, 7e-11 / unit_density(), &x) && at_density(b, 7e-11 / unit_density(), &y)) {
        const double ratio = x.error / y.error, robust = x.ratio / y.ratio;
        snprintf(text, sizeof text, "%.1f times at 7e-11 g/cm^3", ratio);
        claim(r, "Figure 5", size, "error before the sink, control / cleaned", "10 (an order of magnitude)", text, ratio >= 10,
              "the control's error falls faster with the number of particles than the cleaned one, which falls as h does");
        before(r, size, pa, ratio, 0);
        if (asserted) {
            report_factor(report_beside(r, REPORT_REGRESSION), "independent", size, "error before the sink (7e-11 g/cm^3), control / cleaned", 13, ratio, 2);
            report_range(r, "independent", size, "ratio of means before the sink, control / cleaned", (double)NAN, robust, 6, HUGE_VAL);
        } else report_info(r, "Figure 5", size, "ratio of means before the sink, control / cleaned", robust);
    }
    if (a->core.m > 0 && b->core.m > 0) {
        /* the more particles, the longer it takes until the control breaks up: as long as both have gone on */
        const double within = fmin(5e-3, fmin(after_sink(a), after_sink(b))), peak_a = LARGEST(a, moved, within * tff),
                     peak_b = LARGEST(b, moved, within * tff), ch_a = LARGEST(a, ch, 5e-3 * tff), ch_b = LARGEST(b, ch, 5e-3 * tff);
        const outcome *const both[2] = {a, b};
        for (k = 0; k < 2; k++)
            if (asserted) report_range(r, size, k ? pb->name : pa->name, "t_ff until the sink forms", (double)NAN, both[k]->core.born / tff, 0.88, 1);
            else report_info(r, size, k ? pb->name : pa->name, "t_ff until the sink forms", both[k]->core.born / tff);
        snprintf(text, sizeof text, "%.2e / %.2e = %.3g within %.2g t_ff after the sink", peak_a, peak_b, peak_a / peak_b, within);
        claim(r, "Figure 6", size, "momentum made, control / cleaned", "100 (two orders of magnitude)", text, peak_a / peak_b >= 100,
              "the control's momentum still rises when it stops: resistivity holds it back, and the more particles there are, the later it rises");
        if (at_density(a, 1e-11 / unit_density(), &x)) {
            snprintf(text, sizeof text, "%.3g times what it was at 1e-11 g/cm^3", peak_a / x.moved);
            claim(r, "Figure 6", size, "control: a sharp increase at the peak of the density", "yes", text, peak_a / x.moved >= 5, "at this resolution");
        }
        before(r, size, pa, 0, LARGEST(a, moved, 5e-4 * tff) / LARGEST(b, moved, 5e-4 * tff));
        if (asserted) {
            report_factor(report_beside(r, REPORT_REGRESSION), "independent", size, "momentum made within 5e-4 t_ff, control / cleaned", 110,
                          LARGEST(a, moved, 5e-4 * tff) / LARGEST(b, moved, 5e-4 * tff), 10);
            report_range(r, size, pb->name, "largest ch within 5e-3 t_ff after the sink", (double)NAN, ch_b, 0, 5);
            report_range(r, size, pa->name, "largest ch after the sink", (double)NAN, ch_a, 10, HUGE_VAL);
            report_range(r, size, pb->name, "t_ff that the run goes on after the sink", (double)NAN, after_sink(b), 0.005, HUGE_VAL);
            report_range(r, size, pb->name, "largest error after the sink", (double)NAN, LARGEST(b, error, HUGE_VAL), 0, 0.15);
        } else {
            report_info(r, size, pb->name, "largest ch within 5e-3 t_ff after the sink", ch_b);
            report_info(r, size, pa->name, "largest ch after the sink", ch_a);
            report_info(r, size, pb->name, "largest error after the sink", LARGEST(b, error, HUGE_VAL));
        }
    }
}

/* Forces alone: direct summation and without (9), nothing makes momentum. A small cloud half of the way. */
static void check_momentum(report *r, const setting *s)
{
    const plan p = {"momentum", 1, 300, 0, 0.1, 0, 0, 0, 0};
    collapse_model model = model_of(s, &p);
    collapse g;
    double p0[3], p1[3], size = 0;
    sph_index i, shortest;
    int c, n;
    model.theta = 0;
    model.tensile = 0;
    n = cloud(&g, &model, p.particles, s->mass_to_flux);
    collapse_momentum(&g, p0);
    if (collapse_rates(&g)) fail("the start: %s", g.trouble);
    while (g.s.t < 0.7 * free_fall())
        if (collapse_step(&g, collapse_longest_step(&g, &shortest))) fail("without (9): %s", g.trouble);
    collapse_momentum(&g, p1);
    for (c = 0; c < 3; c++) p1[c] -= p0[c];
    for (i = 0; i < g.s.n; i++) size += g.model.m * sqrt(pow(g.a[VX][i], 2) + pow(g.a[VY][i], 2) + pow(g.a[VZ][i], 2));
    {
        char text[64];
        snprintf(text, sizeof text, "%d particles in the sphere, %ld steps", n, g.s.steps);
        report_range(report_beside(r, REPORT_THEORY), text, "without (9), gravity by all pairs", "momentum made by 0.7 t_ff / sum m |v|", 0, collapse_length(p1) / size, 0, 1e-13);
    }
    collapse_free(&g);
}

static void check_setup(report *r, const setting *s)
{
    const double B0 = field_of(s->mass_to_flux);
    report_relative(r, "Section IV-C", "sphere", "density [g/cm^3]", 7.43e-18, cloud_density() * unit_density(), 2e-3);
    report_relative(r, "Section IV-C", "sphere", "free-fall time [years]", 24000, free_fall() * unit_time() / YEAR, 0.03);
    report_absolute(report_beside(r, REPORT_THEORY), "independent", "code units", "free-fall time", 8.886, free_fall(), 1e-3);
    if (s->mass_to_flux == 5) {
        report_absolute(report_beside(r, REPORT_REGRESSION), "independent", "mass-to-flux ratio 5", "field [microgauss]", 163, B0 * unit_gauss() * 1e6, 1);
        report_absolute(report_beside(r, REPORT_REGRESSION), "independent", "mass-to-flux ratio 5", "plasma beta", 3.4, 2 * SOUND * SOUND * cloud_density() / (B0 * B0), 0.05);
    }
}

enum { RUNS = 16 };
static void write_history(FILE *to, const plan *p, const outcome *o)
{
    long k;
    for (k = 0; k < o->r.samples; k++) {
        const sample *const x = &o->at[k];
        fprintf(to, "%d,\"%s\",%.8g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", o->r.inside, p->name, time_of(o, k), x->dt,
                x->densest * unit_density(), x->error, x->error_cloud, x->ratio, x->moved, x->tree, x->field_force, x->ch, x->core);
    }
}

int main(int argc, char **argv)
{
    const char *which = "both";
    static report r;
    static outcome o[RUNS];
    plan plans[RUNS];
    setting s = {0};
    int particles = 0, everywhere = 0, count = 0, k;
    double alpha_B = 0.1, end = 1.1, after = -1;
    FILE *history;
    const option_spec specs[] = {
        {"out", "folder of the result table and of restarts", OPTION_TEXT, &s.out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &s.figures, 0, 0},
        {"full", "10000 and 30000 particles, too, and other alpha_B: more than an hour", OPTION_FLAG, &s.full, 0, 0},
        {"particles", "in the sphere: this number alone", OPTION_INT, &particles, 100, 2000000},
        {"runs", "control, cleaned, or both", OPTION_TEXT, &which, 0, 0},
        {"end", "end of a run, in free-fall times", OPTION_REAL, &end, 1e-3, 10},
        {"after", "end of a run after its sink has formed, in free-fall times; negative: 5e-4 (control), 0.02 (cleaned)", OPTION_REAL, &after, -1, 10},
        {"alpha-B", "resistivity: the most of it, where B changes within h", OPTION_REAL, &alpha_B, 0, 1},
        {"everywhere", "the same resistivity for all particles", OPTION_FLAG, &everywhere, 0, 0},
        {"sigma", "damping of the cleaning", OPTION_REAL, &s.sigma, 0, 10},
        {"mass-to-flux", "ratio over the critical one", OPTION_REAL, &s.mass_to_flux, -DBL_MAX, DBL_MAX},
        {"sink-radius", "accretion radius [AU]", OPTION_REAL, &s.sink_radius, -DBL_MAX, DBL_MAX},
        {"theta", "opening angle of the tree", OPTION_REAL, &s.theta, 1e-3, 1},
        {"direct", "gravity by all pairs instead", OPTION_FLAG, &s.direct, 0, 0},
        {"no-zeta", "gravity without the term of an h that follows the density", OPTION_FLAG, &s.no_zeta, 0, 0},
        {"courant", "time step over its limit", OPTION_REAL, &s.courant, 1e-3, 1},
        {"shortest", "time step that ends a run [code units]", OPTION_REAL, &s.shortest, 0, 1},
        {"vtk", "write particles every so many free-fall times (folder of the figures); 0: never", OPTION_REAL, &s.vtk, 0, 10},
        {"continue", "go on from the restarts in the folder of the results, also to a later end", OPTION_FLAG, &s.go_on, 0, 0},
        THREADS_OPTION,
    };
    s.out = s.figures = ".";
    s.sigma = sph_cleaning_sigma(3);
    s.mass_to_flux = 5;
    s.sink_radius = 6.7;
    s.theta = 0.4;
    s.courant = 0.3;
    s.shortest = 1e-7;
    options_parse(argc, argv, "Collapse of a magnetised molecular cloud core, figures 4 to 6 of the paper on divergence cleaning: published against measured.",
                  specs, (int)(sizeof specs / sizeof *specs));
    if (!(s.mass_to_flux > 0)) {
        fprintf(stderr, "%s: option -mass-to-flux: %g is impossible; a mass-to-flux ratio is positive, and above 1 for a collapse\n", argv[0], s.mass_to_flux);
        return 2;
    }
    if (!(s.sink_radius > 0)) {
        fprintf(stderr, "%s: option -sink-radius: %g AU is impossible; it must be positive\n", argv[0], s.sink_radius);
        return 2;
    }
    if (strcmp(which, "control") != 0 && strcmp(which, "cleaned") != 0 && strcmp(which, "both") != 0) {
        fprintf(stderr, "%s: option -runs: '%s' is none of control, cleaned, both\n", argv[0], which);
        return 2;
    }
    report_open(&r, "cleaning_collapse", s.out);
    figure_folder(s.figures, "cleaning_collapse");
    signal(SIGINT, interrupt);
#define PLAN(title, clean, number, same, resistivity, longer, most) \
    do { \
        const plan p = {title, clean, number, same, resistivity, end * free_fall(), (longer)*free_fall(), 0, most}; \
        plans[count++] = p; \
        s.work += pow(p.particles, 4.0 / 3); \
    } while (0)
    if (particles > 0) {
        if (strcmp(which, "cleaned") != 0) PLAN("control", 0, particles, everywhere, alpha_B, after < 0 ? 5e-4 : after, 20000);
        if (strcmp(which, "control") != 0) PLAN("cleaned", 1, particles, everywhere, alpha_B, after < 0 ? 0.02 : after, 0);
    } else {
        PLAN("control", 0, 2000, everywhere, alpha_B, 5e-4, 800);
        PLAN("cleaned", 1, 2000, everywhere, alpha_B, s.full ? 0.02 : 0.01, 0);
        if (s.full) {
            PLAN("control with alpha_B = 0", 0, 2000, everywhere, 0, 5e-4, 2000);
            PLAN("cleaned with alpha_B = 0", 1, 2000, everywhere, 0, 0.02, 0);
            PLAN("control with alpha_B = 0.1 everywhere", 0, 2000, 1, 0.1, 5e-4, 2000);
            PLAN("cleaned with alpha_B = 0.1 everywhere", 1, 2000, 1, 0.1, 0.02, 0);
            PLAN("control", 0, 10000, everywhere, alpha_B, 5e-3, 2000);
            PLAN("cleaned", 1, 10000, everywhere, alpha_B, 1, 0);
            PLAN("control with alpha_B = 0", 0, 10000, everywhere, 0, 5e-4, 2000);
            PLAN("cleaned with alpha_B = 0", 1, 10000, everywhere, 0, 5e-4, 0);
            PLAN("control", 0, 30000, everywhere, alpha_B, 5e-3, 2000);
            PLAN("cleaned", 1, 30000, everywhere, alpha_B, 0.02, 0);
        }
    }
#undef PLAN
    report_section(&r, "the set-up");
    check_setup(&r, &s);
    check_momentum(&r, &s);
    progress_begin(&s.show, r.name, 0);
    for (k = 0; k < count && !interrupted; k++) {
        if (plans[k].cleans && k > 0 && !plans[k - 1].cleans) {
            plans[k].panel = o[k - 1].at[o[k - 1].r.samples - 1].t; /* figure 4: both at the same time */
            plans[k].after = fmax(plans[k].after, 5e-4 * free_fall());
        }
        run(&s, &plans[k], &o[k]);
    }
    progress_end(&s.show);
    history = figure_open(s.figures, "cleaning_collapse_fig5");
    fprintf(history, "particles,run,t_ff,dt,largest_density,error,error_cloud,ratio_of_means,momentum_change,momentum_by_tree,force_by_9,ch,sink_mass\n");
    for (k = 0; k < count; k++)
        if (o[k].at) write_history(history, &plans[k], &o[k]);
    figure_close(history);
    if (interrupted) {
        fprintf(stderr,
                "cleaning_collapse: interrupted; -continue goes on from the restart in %s. The figures' data so far are in %s, and there is no result table\n",
                s.out, s.figures);
        return 130;
    }
    for (k = 0; k < count; k++) {
        char size[48];
        snprintf(size, sizeof size, "%d in the sphere", o[k].r.inside);
        if (k == 0 || plans[k].particles != plans[k - 1].particles) report_section(&r, size);
        list_run(&r, size, &plans[k], &o[k]);
        if (k > 0 && plans[k].cleans && !plans[k - 1].cleans)
            compare(&r, size, &plans[k - 1], &o[k - 1], &plans[k], &o[k], plans[k].particles == 2000 && k == 1);
    }
    for (k = 0; k < count; k++) free(o[k].at);
    return report_close(&r) ? 1 : 0;
}
