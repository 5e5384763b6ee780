/* SPDX-License-Identifier: MIT
 *
 * clustering_dam.c - figures 7 to 9 of the paper on particle clustering: a dam breaks, water and air (section V.IV), by several methods; its front beside theory and experiments.
 *
 *     cc -O2 -o clustering_dam examples/papers/clustering_dam.c -lm
 *     clustering_dam -out DIR -figures DIR [-full]       (-h for help)
 *     clustering_dam -kernel wendland-c2 -remedy sequential -dref 0.02 -dt 2e-4 -tend 0.7       a run of your own
 *
 * Tank of 1 m x 0.5 m, water of 0.5 m x 0.2 m in its left corner, air elsewhere; hexagonal lattice of dref, ghosts of zero pressure behind the walls as far as the support reaches; rho0 = 1000 and 1, c = 10,
 * p0 = 0, alpha = 0.01, h = 1.5 dref; at rest with hydrostatic pressure, the density that belongs to it, and mass = density x volume. Collisions of fluid with ghosts in all runs, as the paper has it.
 * Quick runs: dref = 1/100 and dt = 1e-4, 1/50 and 2e-4 for what lasts; -full: the paper's 1/200 and 5e-6.
 *
 * Equations: (5.23), (5.24). The paper says that it used those for its tank only, which leaves (2.2), (2.3) for this case; but a sum over masses smears the density over an interface of 1000 : 1,
 * and what then happens (see 'which equations') is not what figures 8 and 9 show. The density moves on by the velocities of the end of the step: by those of its beginning the step is unstable.
 */
#define FLOW_PERIODIC 0
#include "clustering.h"
#include "../common/column.h"

typedef struct tank {
    double width, height, water_width, water_height, c;
} tank;
static const tank dam = {1, 0.5, 0.5, 0.2, 10};
static const double gravity = 9.81;

enum { WATER, AIR };

typedef struct scenario {
    const char *name, *file;
    sph_kernel kernel;
    int form, old_rate; /* old_rate: density by the velocities of the beginning of the step */
    int remedy, walls;  /* remedy: for all pairs, or with walls = 1 for those of fluid and ghost only */
    int phases;
    double p0;
} scenario;

typedef struct outcome {
    flow_answer answer;
    double t; /* of the end */
    char blow_up[160];
    flow_distribution d;
    double front;  /* at t */
    double centre; /* of mass of the water: x */
    int lost;     /* fluid particles outside of the tank by more than dref / 2 */
    double kinetic_energy, fastest, microseconds;
    double steps_per_list; /* how long neighbour lists lasted */
    int particles;         /* of fluid */
    front_record front_of;
} outcome;

/* ---------------------------------------------------------------- the flow */

/* what the hook of a run needs: the front is how far water has come below a quarter of its first height */
typedef struct watch {
    double below;
    front_record front;
} watch;

static double front(const flow *f, double below)
{
    double x = 0;
    int i;
    for (i = 0; i < f->n_fluid; i++)
        if (f->phase[i] == WATER && f->y[i] < below) x = fmax(x, f->x[i]);
    return x;
}
static void watch_front(flow *f)
{
    watch *w = (watch *)f->data;
    if (front_due(&w->front, f->t)) front_add(&w->front, f->t, front(f, w->below));
}
/* Rows half a lattice distance above the bottom, and every other one shifted by half a particle: a quarter of dref from the left wall, or three. */
static void fill(flow *f, const tank *b, int phases)
{
    const double dy = hexagonal * f->dref, V = f->dref * dy,
                 reach = sph_kernel_support_ratio(f->kernel) * f->h * (1 - 1e-9);
    const int layers = (int)(reach / dy) + 1, rows = (int)(b->height / dy) + layers + 1,
              columns = (int)(b->width / f->dref) + layers + 1;
    int ghosts, row, column;
    for (ghosts = 0; ghosts < 2; ghosts++)
        for (row = -layers; row < rows; row++)
            for (column = -layers - 1; column < columns; column++) {
                const double x = (column + 0.25 + 0.5 * (row % 2 != 0)) * f->dref, y = (row + 0.5) * dy;
                const int inside = x > 0 && x < b->width && y > 0 && y < b->height,
                          water = x < b->water_width && y < b->water_height;
                const sph_tait *const s = &f->state[water ? WATER : AIR];
                if (ghosts && !inside && x > -reach && x < b->width + reach && y > -reach &&
                    y < b->height + reach)
                    flow_add_ghost(f, x, y, water ? WATER : AIR, s->rho0 * V);
                if (!ghosts && inside && (water || phases > 1)) {
                    const double air = phases > 1 ? f->state[AIR].rho0 * gravity : 0;
                    const double p = s->p0 + (water ? f->state[WATER].rho0 * gravity * (b->water_height - y) +
                                                          air * (b->height - b->water_height)
                                                    : air * (b->height - y));
                    const double rho = sph_density_tait(p, *s);
                    const int i = flow_add(f, x, y, water ? WATER : AIR, rho * V);
                    f->rho[i] = rho;
                }
            }
}

static void open_dam(flow *f, const scenario *s, const tank *b, double dref, double smoothing, double dt,
                     watch *w)
{
    flow_open(f, s->name, s->kernel, dref, smoothing * dref);
    f->dt = dt;
    f->gravity_y = -gravity;
    f->state[WATER].rho0 = 1000;
    f->state[AIR].rho0 = 1;
    f->state[WATER].p0 = f->state[AIR].p0 = s->p0;
    f->state[WATER].c = f->state[AIR].c = b->c;
    f->form = s->form;
    f->rate_after_kick = !s->old_rate;
    f->alpha = 0.01;
    f->remedy = s->remedy;
    f->walls_only = s->walls;
    fill(f, b, s->phases);
    w->below = 0.25 * b->water_height;
    w->front.count = 0;
    f->data = w;
    f->after = watch_front;
    watch_front(f);
}

static void measure(flow *f, const tank *b, outcome *o)
{
    const flow_domain all = {0, b->width, 0, b->height};
    const double half = 0.5 * f->dref;
    double mass = 0;
    int i;
    o->t = f->t;
    o->lost = 0;
    o->fastest = o->centre = 0;
    for (i = 0; i < f->n_fluid; i++) {
        if (f->phase[i] == WATER) {
            mass += f->m[i];
            o->centre += f->m[i] * f->x[i];
        }
        o->lost +=
            !(f->x[i] > -half && f->x[i] < b->width + half && f->y[i] > -half && f->y[i] < b->height + half);
        o->fastest = fmax(o->fastest, sqrt(f->vx[i] * f->vx[i] + f->vy[i] * f->vy[i]));
    }
    o->centre /= mass;
    o->front = front(f, ((const watch *)f->data)->below);
    o->kinetic_energy = flow_kinetic_energy(f);
    o->microseconds = flow_microseconds(f);
    o->steps_per_list = (double)f->steps / (double)f->rebuilds;
    o->particles = f->n_fluid;
    if (o->answer == FLOW_DONE) o->d = flow_measure(f, FLOW_ALL, 0, all, NULL);
}

/* From one of the times to the next, with what is so at each (outcome[k] of times[k], the last of them complete), and a picture of it. A run that blows up ends there: the rest of outcome[] says so. */
static void run(const clustering_options *c, const scenario *s, const tank *b, double dref, double smoothing,
                double dt, const double *times, int count, const char *figure, outcome *o)
{
    static watch w; /* large */
    char file[96];
    flow f;
    int k;
    w.front.every = times[count - 1] / (FRONT_SAMPLES - 1);
    open_dam(&f, s, b, dref, smoothing, dt, &w);
    f.quiet = c->quiet;
    f.vtk = c->vtk ? c->out : NULL;
    flow_restarts(&f, c, &w, sizeof w);
    for (k = 0; k < count; k++) {
        if (k > 0 && o[k - 1].answer == FLOW_BLEW_UP) {
            o[k] = o[k - 1];
            continue;
        }
        memset(&o[k], 0, sizeof o[k]);
        o[k].answer = flow_run(&f, times[k]);
        if (o[k].answer == FLOW_INTERRUPTED) flow_require(&f, o[k].answer);
        o[k].front_of = w.front;
        measure(&f, b, &o[k]);
        if (o[k].answer == FLOW_BLEW_UP)
            snprintf(o[k].blow_up, sizeof o[k].blow_up, "t = %.4f: a particle of %s at (%.3f, %.3f): %s", f.t,
                     f.phase[f.bad] == WATER ? "water" : "air", f.x[f.bad], f.y[f.bad], f.bad_what);
        if (!figure) continue;
        snprintf(file, sizeof file, "clustering_%s_%s_%03.0f", figure, s->file, 1000 * times[k]);
        flow_snapshot(&f, c->figures, file);
    }
    flow_close(&f);
}

/* ---------------------------------------------------------------- rows of the table */

static void info(report *r, const char *item, const char *setting, const char *quantity, double measured,
                 double known)
{
    char criterion[REPORT_CRITERION] = "";
    if (!isnan(known)) snprintf(criterion, sizeof criterion, "independent program: %g", known);
    report_number_row(r, item, setting, quantity, (double)NAN, measured, criterion, NULL, REPORT_INFO);
}

/* known: mean, least, f(<0.5), f(<0.75), void, hole, front, kinetic energy of an independent program; null: nothing known */
static void distribution_rows(report *r, const char *item, const char *setting, const outcome *o,
                              const double *known)
{
    static const char *const quantity[] = {"mean distance to the nearest / dref",
                                           "least distance / dref",
                                           "f(<0.5)",
                                           "f(<0.75)",
                                           "void: area farther than 0.85 dref from any",
                                           "largest hole / dref (radius)",
                                           "front [m]",
                                           "kinetic energy [J/m]"};
    const double value[] = {o->d.mean,       o->d.least, o->d.below_50, o->d.below_75,
                            o->d.void_share, o->d.hole,  o->front,      o->kinetic_energy};
    int k;
    if (o->answer == FLOW_BLEW_UP) {
        report_row(r, item, setting, "blew up", NULL, o->blow_up, NULL, "picture: the last one of this run",
                   REPORT_INFO);
        return;
    }
    for (k = 0; k < 8; k++) info(r, item, setting, quantity[k], value[k], known ? known[k] : (double)NAN);
    info(r, item, setting, "particles outside of the tank", o->lost, (double)NAN);
    info(r, item, setting, "CPU time of a particle and step [us]", o->microseconds, (double)NAN);
}

/* ---------------------------------------------------------------- figures 7, 8: t = 0.1; the front until t = 0.3 */

enum { UNTREATED, CONVEX, COLLISIONS, SINGLE, SINGLE_COLLISIONS, METHODS };
static const scenario methods[METHODS] = {
    {"(1.1)", "wendland", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 0, FLOW_SEQUENTIAL, 1, 2, 0},
    {"(3.9)", "convex", SPH_CONVEX, FLOW_CONTINUITY, 0, FLOW_SEQUENTIAL, 1, 2, 0},
    {"(1.1) + collisions", "collisions", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 0, FLOW_SEQUENTIAL, 0, 2, 0},
    {"(1.1), water only", "single", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 0, FLOW_SEQUENTIAL, 1, 1, 0},
    {"(1.1) + collisions, water only", "single_collisions", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 0,
     FLOW_SEQUENTIAL, 0, 1, 0},
};
/* an independent program at t = 0.1, dref = 1/200, dt = 2e-5 */
static const double known[METHODS][8] = {{.819, .000, .071, .244, .0033, 1.30, .592, 7.90},
                                         {.890, .056, .022, .095, .0007, 1.26, .594, 7.87},
                                         {.915, .690, 0, 0, 0, 0.84, .588, 7.28}};
/* and its fronts at t = 0.1, 0.2, 0.3 and their speed from 0.2 on, dref = 1/100 */
static const double known_front[METHODS][4] = {{.581, .764, .955, 1.91},
                                               {.582, .761, .965, 2.04},
                                               {.571, .734, .903, 1.69},
                                               {.587, .777, .979, 2.02},
                                               {.575, .742, .905, 1.63}};

static void early(report *r, const outcome *o, int full)
{
    char text[96];
    int k;
    report_section(r, full ? "Figure 8: t = 0.1, dref = 1/200"
                           : "Figure 8: t = 0.1, dref = 1/100 (paper: 1/200)");
    for (k = UNTREATED; k <= COLLISIONS; k++)
        distribution_rows(r, "Figure 8", methods[k].name, &o[k], full ? known[k] : NULL);
    /* in full runs not 0: at dref = 1/200 one pair of 23000 particles is closer */
    report_range(r, "Figure 8", methods[COLLISIONS].name, "'great improvement': f(<0.5), with / without",
                 (double)NAN, o[COLLISIONS].d.below_50 / o[UNTREATED].d.below_50, 0, full ? 0.01 : 0);
    report_range(r, "Figure 8", methods[COLLISIONS].name,
                 "'the interface looks very good': void, to four decimals", (double)NAN,
                 o[COLLISIONS].d.void_share, 0, 5e-5);
    snprintf(text, sizeof text, "void %.4f, %.4f, %.4f", o[UNTREATED].d.void_share, o[CONVEX].d.void_share,
             o[COLLISIONS].d.void_share);
    report_claim(r, "Figure 8", "(1.1), (3.9), collisions",
                 "'large cavities', 'better, but still cavities', none", "pictures", text, "in this order",
                 o[UNTREATED].d.void_share > o[CONVEX].d.void_share &&
                     o[CONVEX].d.void_share > o[COLLISIONS].d.void_share);
    snprintf(text, sizeof text, "f(<0.5) = %.3f, %.3f", o[UNTREATED].d.below_50, o[CONVEX].d.below_50);
    report_claim(r, "Figure 8", "(1.1), (3.9)", "'the distribution within the fluids is much better'",
                 "pictures", text, "less than half", o[CONVEX].d.below_50 < 0.5 * o[UNTREATED].d.below_50);
}

static double speed(const outcome *o)
{
    return (front_at(&o->front_of, 0.3) - front_at(&o->front_of, 0.2)) / 0.1;
}

/* o: of t = 0.3 */
static void fronts(report *r, const outcome *o, const clustering_options *c)
{
    const double wave = sqrt(gravity * dam.water_height);
    char text[96], setting[96];
    part_file to;
    int k, s;
    report_section(r, "The front of the water: Ritter's is 2 sqrt(gH) = 2.801 m/s fast");
    clustering_figure(&to, c->figures, "clustering_front");
    fprintf(to.to, "run,t,x\n");
    for (k = 0; k < METHODS; k++) {
        const front_record *f = &o[k].front_of;
        const double v = speed(&o[k]);
        for (s = 0; s < f->count; s++) fprintf(to.to, "%s,%.6g,%.6g\n", methods[k].file, f->t[s], f->x[s]);
        if (isnan(v)) continue;
        snprintf(text, sizeof text, "%.3f %.3f %.3f", front_at(f, 0.1), front_at(f, 0.2), front_at(f, 0.3));
        snprintf(setting, sizeof setting, "independent program: %.3f %.3f %.3f", known_front[k][0],
                 known_front[k][1], known_front[k][2]);
        report_row(r, "front", methods[k].name, "x at t = 0.1, 0.2, 0.3 [m]", NULL, text,
                   c->full ? NULL : setting, NULL, REPORT_INFO);
        info(r, "front", methods[k].name, "speed, t = 0.2 to 0.3 [m/s]", v,
             c->full ? (double)NAN : known_front[k][3]);
        report_range(report_beside(r, REPORT_THEORY), "front", methods[k].name, "speed / sqrt(gH) (Ritter: 2)", 2, v / wave, 1.1,
                     2);
    }
    clustering_figure_close(&to);
}

/* Beyond the paper, which looks at t = 0.7 (below). o: of t = 0.3 or later, all with the same dref; what was
   not run for as long is left out. */
static void slower_fronts(report *r, const outcome *o, double dref)
{
    char text[96], setting[64];
    int k;
    for (k = 0; k < 2; k++) {
        const int without = k ? SINGLE : UNTREATED, with = k ? SINGLE_COLLISIONS : COLLISIONS;
        const double a = speed(&o[without]), b = speed(&o[with]);
        if (isnan(a) || isnan(b)) continue;
        snprintf(setting, sizeof setting, "%s, dref = 1/%.0f", k ? "water only" : "water and air", 1 / dref);
        snprintf(text, sizeof text, "%.2f m/s without, %.2f m/s with: %+.0f %%; x(0.3) = %.3f, %.3f", a, b,
                 100 * (b / a - 1), front_at(&o[without].front_of, 0.3), front_at(&o[with].front_of, 0.3));
        report_claim_known(r, "beyond", setting, "the front with collisions is not slower, t = 0.2 to 0.3", "",
                           text, "within 2 %", b >= 0.98 * a, 0,
                           "collisions are a viscosity: the less, the finer the lattice");
    }
}

/* ---------------------------------------------------------------- figure 9: t = 0.7 */

/* how far the water's centre of mass has come */
static double way(const outcome *o) { return o->centre - 0.5 * dam.water_width; }
static void late(report *r, const outcome *o, double dref)
{
    const double with = way(&o[COLLISIONS]), without = way(&o[UNTREATED]), alone = way(&o[SINGLE]);
    char text[160];
    int k;
    snprintf(text, sizeof text, "Figure 9: t = 0.7, dref = 1/%.0f (paper: 1/200)", 1 / dref);
    report_section(r, text);
    for (k = 0; k < METHODS; k++)
        if (k != CONVEX) distribution_rows(r, "Figure 9", methods[k].name, &o[k], NULL);
    if (o[UNTREATED].answer == FLOW_DONE) {
        snprintf(text, sizeof text, "void %.4f, f(<0.5) = %.3f", o[UNTREATED].d.void_share,
                 o[UNTREATED].d.below_50);
        report_claim(r, "Figure 9", methods[UNTREATED].name,
                     "'many voids visible, particles are clearly clustering'", "picture", text,
                     "void > 0.01, f(<0.5) > 0.2",
                     o[UNTREATED].d.void_share > 0.01 && o[UNTREATED].d.below_50 > 0.2);
    }
    snprintf(text, sizeof text, "void %.4f, f(<0.5) = %.3f, %d outside", o[COLLISIONS].d.void_share,
             o[COLLISIONS].d.below_50, o[COLLISIONS].lost);
    report_claim(r, "Figure 9", methods[COLLISIONS].name, "'much better', 'hardly any voids'", "picture",
                 text, "void < 0.002, f(<0.5) < 0.05",
                 o[COLLISIONS].answer == FLOW_DONE && o[COLLISIONS].d.void_share < 0.002 &&
                     o[COLLISIONS].d.below_50 < 0.05);
    for (k = 0; k < METHODS; k++)
        if (k != CONVEX && o[k].answer == FLOW_DONE)
            info(r, "Figure 9", methods[k].name, "the water's centre of mass has moved by [m]", way(&o[k]),
                 (double)NAN);
    snprintf(text, sizeof text, "the water's centre has moved %.4f m without, %.4f m with: %+.1f %%", without,
             with, 100 * (with / without - 1));
    report_claim_known(r, "Figure 9", "water and air", "'the flow with collisions is not slower'", "pictures",
                       text, "at most 2 % less", with >= 0.98 * without, dref < 0.006,
                       "a coarse lattice: at the paper's 1/200 it is not");
    snprintf(text, sizeof text, "%.4f m with air, %.4f m without: %+.1f %%; front at t = 0.3: %.3f, %.3f m",
             without, alone, 100 * (without / alone - 1), front_at(&o[UNTREATED].front_of, 0.3),
             front_at(&o[SINGLE].front_of, 0.3));
    report_claim_known(r, "Figure 9", "without collisions",
                       "'the multiphase flow is slower than the single phase flow'", "pictures", text,
                       "less far", without < alone, 0,
                       "only the front is, and less so the finer the lattice");
}

/* ---------------------------------------------------------------- which equations, and what walls need */

static void equations(report *r, const clustering_options *c, double dref, double dt)
{
    static const scenario others[] = {
        {"(5.23), (5.24)", "continuity", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 0, FLOW_SEQUENTIAL, 1, 2, 0},
        {"(2.2), (2.3)", "summation", SPH_WENDLAND_C2_1D, FLOW_SUMMATION, 0, FLOW_SEQUENTIAL, 1, 2, 0},
        {"(2.2), (2.3) + collisions", "summation_collisions", SPH_WENDLAND_C2_1D, FLOW_SUMMATION, 0,
         FLOW_SEQUENTIAL, 0, 2, 0},
        {"Hu & Adams", "hu_adams", SPH_WENDLAND_C2_1D, FLOW_NUMBER, 0, FLOW_SEQUENTIAL, 1, 2, 0},
        {"Hu & Adams + collisions", "hu_adams_collisions", SPH_WENDLAND_C2_1D, FLOW_NUMBER, 0,
         FLOW_SEQUENTIAL, 0, 2, 0},
        {"no collisions with walls", "open_walls", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 0, FLOW_NO_COLLISIONS,
         0, 2, 0},
        {"density by old velocities", "old_rate", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 1, FLOW_SEQUENTIAL, 1,
         2, 0},
    };
    enum {
        OTHERS = sizeof others / sizeof *others,
        CONTINUITY = 0,
        SUMMATION,
        SUMMATION_COLLISIONS,
        HU_ADAMS,
        HU_ADAMS_COLLISIONS,
        OPEN_WALLS,
        OLD_RATE
    };
    static outcome o[OTHERS];
    const double end = 0.1, available = 0.5 * 1000 * gravity * dam.water_width * dam.water_height *
                                        dam.water_height * (1 - dam.water_width / dam.width);
    char text[160];
    int k;
    snprintf(text, sizeof text, "Which equations: t = 0.1, dref = 1/%.0f", 1 / dref);
    report_section(r, text);
    for (k = 0; k < OTHERS; k++) {
        run(c, &others[k], &dam, dref, 1.5, dt, &end, 1, "dam", &o[k]);
        if (o[k].answer == FLOW_BLEW_UP) {
            report_row(r, "equations", others[k].name, "blew up", NULL, o[k].blow_up, NULL,
                       "picture: the last one of this run", REPORT_INFO);
            continue;
        }
        snprintf(text, sizeof text,
                 "void %.4f, hole %.2f dref, f(<0.5) %.3f, %.1f J/m, front %.3f, %d outside",
                 o[k].d.void_share, o[k].d.hole, o[k].d.below_50, o[k].kinetic_energy, o[k].front, o[k].lost);
        report_row(r, "equations", others[k].name, "at t = 0.1", NULL, text, NULL, NULL, REPORT_INFO);
    }
    snprintf(
        text, sizeof text,
        "kinetic energy %.0f J/m of %.0f that the water could ever give; void %.3f, with collisions %.3f",
        o[SUMMATION].kinetic_energy, available, o[SUMMATION].d.void_share,
        o[SUMMATION_COLLISIONS].d.void_share);
    if (o[SUMMATION].answer == FLOW_BLEW_UP) snprintf(text, sizeof text, "%s", o[SUMMATION].blow_up);
    report_claim_fails(
        r, "Section V.IV", "water and air by (2.2), (2.3)", "equations",
        "(5.23), (5.24) 'for this problem only', i.e. the tank", text,
        "the sum smears the density over the interface: pressures of both signs, c^2 x hundreds of kg/m2");
    snprintf(text, sizeof text, "void %.4f, %.4f; with collisions %.4f; front %.3f, %.3f",
             o[HU_ADAMS].d.void_share, o[CONTINUITY].d.void_share, o[HU_ADAMS_COLLISIONS].d.void_share,
             o[HU_ADAMS].front, o[CONTINUITY].front);
    report_claim(r, "beyond", "Hu & Adams, (5.23) + (5.24)", "two forms that take density jumps", "", text,
                 "fronts within 2 %", fabs(o[HU_ADAMS].front / o[CONTINUITY].front - 1) < 0.02);
    snprintf(text, sizeof text, "%d outside of the tank without, %d with", o[OPEN_WALLS].lost,
             o[CONTINUITY].lost);
    report_claim(r, "Section V.IV", "collisions with walls", "'an extra measure to keep particles inside'",
                 "needed", text, "some without, none with",
                 (o[OPEN_WALLS].lost > 0 || o[OPEN_WALLS].answer == FLOW_BLEW_UP) && o[CONTINUITY].lost == 0);
}

/* ---------------------------------------------------------------- experiments */

static void experiments(report *r, const clustering_options *c, int resolution)
{
    const double a = column_a, end = 3.4 / column_T(1);
    const tank column = {5 * a, 3 * a, a, 2 * a, 10 * sqrt(gravity * 2 * a)};
    const double dref = a / resolution, dt = 0.2 * 1.5 * dref / column.c;
    static outcome o[2];
    char text[96];
    part_file to;
    int k;
    snprintf(text, sizeof text, "Beyond the paper: a column of a x 2a, water only, dref = a/%d", resolution);
    report_section(r, text);
    clustering_figure(&to, c->figures, "clustering_column");
    fprintf(to.to, "run,T,Z\n");
    column_experiment_lines(to.to);
    for (k = 0; k < 2; k++) {
        const scenario *const m = &methods[k ? SINGLE_COLLISIONS : SINGLE];
        run(c, m, &column, dref, 1.5, dt, &end, 1, NULL, &o[k]);
        if (o[k].answer == FLOW_BLEW_UP) {
            report_row(r, "column", m->name, "blew up", NULL, o[k].blow_up, NULL, NULL, REPORT_DIFFERS);
            continue;
        }
        column_lines(to.to, m->file, &o[k].front_of);
        column_rows(r, m->name, &o[k].front_of, 1);
    }
    clustering_figure_close(&to);
}

/* ---------------------------------------------------------------- other kernels */

/* with p0, rho0 c^2 of the air, the ghosts have it, too */
static void kernels(report *r, const clustering_options *c, double dref, double dt)
{
    static const double background[] = {0, 100};
    const double end = 0.1;
    static outcome o;
    char at[96], text[160];
    int p, k;
    snprintf(text, sizeof text, "Kernels beside the paper's: t = 0.1, dref = 1/%.0f", 1 / dref);
    report_section(r, text);
    for (p = 0; p < 2; p++)
        for (k = 0; k < CLUSTERING_KERNELS; k++) {
            scenario s = methods[UNTREATED];
            s.kernel = clustering_kernels[k];
            s.name = sph_kernel_name(s.kernel);
            s.p0 = background[p];
            run(c, &s, &dam, dref, 1.5, dt, &end, 1, NULL, &o);
            snprintf(at, sizeof at, "%s, p0 = %g", s.name, s.p0);
            snprintf(text, sizeof text, "%.3f, %.3f, %.3f; %.4f, %.2f; %.3f; %d", o.d.mean, o.d.below_50,
                     o.d.below_75, o.d.void_share, o.d.hole, o.front, o.lost);
            report_row(r, "kernel", at, "nnd mean, f(<.5), f(<.75); void, hole; front; outside", NULL,
                       o.answer == FLOW_DONE ? text : o.blow_up, NULL, NULL, REPORT_INFO);
        }
}

/* ---------------------------------------------------------------- */

/* figure 7 */
static void initial(const clustering_options *c, double dref)
{
    static watch w;
    flow f;
    w.front.every = 1;
    open_dam(&f, &methods[UNTREATED], &dam, dref, 1.5, 1e-4, &w);
    flow_snapshot(&f, c->figures, "clustering_fig7");
    flow_close(&f);
}

static int own_run(report *r, const clustering_options *c)
{
    scenario own = {c->kernel, "own", SPH_WENDLAND_C2_1D, FLOW_CONTINUITY, 0, FLOW_SEQUENTIAL, 1, 2, 0};
    const double end = clustering_choose(c->tend, 0.7), dref = clustering_choose(c->dref, 0.01);
    outcome o;
    own.kernel = clustering_kernel(c);
    own.remedy = clustering_remedy(c);
    own.walls = own.remedy == FLOW_NO_COLLISIONS;
    if (own.walls) own.remedy = FLOW_SEQUENTIAL;
    run(c, &own, &dam, dref, clustering_choose(c->h, 1.5), clustering_choose(c->dt, 0.01 * dref), &end, 1,
        "dam", &o);
    distribution_rows(r, "own run", own.name, &o, NULL);
    info(r, "own run", own.name, "fluid particles", o.particles, (double)NAN);
    info(r, "own run", own.name, "steps that a neighbour list lasts", o.steps_per_list, (double)NAN);
    return report_close(r) ? 1 : 0;
}

int main(int argc, char **argv)
{
    enum { TIMES = 4, FIRST = 0, SECOND, THIRD, LAST };
    static const double times[TIMES] = {0.1, 0.2, 0.3, 0.7};
    clustering_options c = clustering_defaults();
    const option_spec specs[] = {CLUSTERING_OPTIONS(c), {"continue", CLUSTERING_CONTINUE, OPTION_FLAG, &c.go_on, 0, 0}};
    static report r;
    static outcome o[METHODS][TIMES], at[METHODS];
    double dref, dt;
    int k;
    options_parse(argc, argv,
                  "Figures 7 to 9 of the paper on particle clustering: a dam breaks, water and air.", specs,
                  (int)(sizeof specs / sizeof *specs));
    report_open(&r, "clustering_dam", c.out);
    if (c.kernel) return own_run(&r, &c);
    dref = c.full ? 0.005 : 0.01;
    dt = clustering_choose(c.dt, c.full ? 5e-6 : 1e-4);

    initial(&c, dref);
    if (c.full || c.kernels) kernels(&r, &c, 0.01, clustering_choose(c.dt, 1e-4));
    if (c.kernels) return report_close(&r) ? 1 : 0;
    for (k = 0; k < METHODS; k++) {
        const int count = c.full ? TIMES : k == UNTREATED || k == CONVEX ? 1 : THIRD + 1;
        run(&c, &methods[k], &dam, dref, 1.5, dt, times, count, "dam", o[k]);
        at[k] = o[k][FIRST];
    }
    early(&r, at, c.full);
    for (k = 0; k < METHODS; k++) at[k] = o[k][c.full || (k != UNTREATED && k != CONVEX) ? THIRD : FIRST];
    fronts(&r, at, &c);
    if (!c.full) slower_fronts(&r, at, dref);
    for (k = 0; k < METHODS; k++) {
        if (!c.full && k != CONVEX)
            run(&c, &methods[k], &dam, 0.02, 1.5, 2 * dt, times + LAST, 1, "dam", &o[k][LAST]);
        at[k] = o[k][LAST];
    }
    if (!c.full) dref = 0.02;
    late(&r, at, dref);
    slower_fronts(&r, at, dref);
    equations(&r, &c, c.full ? 0.01 : 0.02, c.full ? 5e-5 : 2e-4);
    experiments(&r, &c, c.full ? 40 : 20);
    return report_close(&r) ? 1 : 0;
}
