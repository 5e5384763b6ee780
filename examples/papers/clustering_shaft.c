/* SPDX-License-Identifier: MIT
 *
 * clustering_shaft.c - figure 6 of the paper on particle clustering: air between a rotating shaft and a wall (section V.III), by four methods.
 *
 *     cc -O2 -o clustering_shaft examples/papers/clustering_shaft.c -lm
 *     clustering_shaft -out DIR -figures DIR [-full]       (-h for help)
 *     clustering_shaft -kernel wendland-c4 -remedy weighted -smoothing 1.5 -dref 0.005 -dt 1e-5 -tend 0.5       a run of your own
 *
 * Shaft of radius 0.04 m at 1000 rpm in a wall of radius 0.1 m; hexagonal lattice of dref = 1/200 m with a particle in the axis; rho0 = 1, c = 10, alpha = 0.1, h = 1.5 dref, t = 0.5; (2.2), (2.3), p0 = 0.
 * Lattice particles inside the shaft (turning with it) and behind the wall (at rest), as far as the support reaches, are ghosts of zero pressure; collisions act on them, too, as on infinite masses.
 * Quick runs take dt = 2e-5, -full the paper's 1e-6.
 *
 * The paper prints no numbers here. What an independent program found with dt = 1e-5 stands beside ours in the criterion column; the flow is chaotic, so that only the size of these numbers can agree.
 */
#define FLOW_PERIODIC 0
#define FLOW_FORM(f) FLOW_SUMMATION
#include "clustering.h"

#define NONE ((double)NAN) /* not measured, or not known */

static const double shaft_radius = 0.04, wall_radius = 0.1;
#define SHAFT_TURNS (1000.0 / 60) /* per second */

enum { BINS = 6 }; /* of r, for the velocity */

/* what is known of the run; NONE: not known */
typedef struct expected {
    double mean, below_50, below_75, void_share, deepest;
    double v[BINS];
} expected;

typedef struct method {
    const char *name, *file;
    sph_kernel kernel;
    int remedy, full_only;
    expected e;
} method;

static const method methods[] = {
    {"(1.1)", "wendland", SPH_WENDLAND_C2_1D, FLOW_NO_COLLISIONS, 0, {.550, .358, .830, .032, 2.18, {1.44, 1.02, .69, .40, .18, .07}}},
    {"(3.7)", "hermite", SPH_HERMITE, FLOW_NO_COLLISIONS, 0, {.160, .934, 1.000, .259, 2.13, {NONE, NONE, NONE, NONE, NONE, NONE}}},
    {"(3.9)", "convex", SPH_CONVEX, FLOW_NO_COLLISIONS, 0, {.763, .018, .387, .0004, .47, {2.66, 1.66, .92, .49, .21, .06}}},
    {"(1.1) + collisions", "collisions", SPH_WENDLAND_C2_1D, FLOW_SEQUENTIAL, 0, {.854, 0, 0, .0006, .15, {2.16, 1.83, 1.35, .85, .45, .11}}},
    {"Wendland C2", "wendland_c2", SPH_WENDLAND_C2, FLOW_NO_COLLISIONS, 1, {.692, .082, .600, .007, NONE, {NONE, NONE, NONE, NONE, NONE, NONE}}},
    {"(1.1) + (4.20) as printed", "literal", SPH_WENDLAND_C2_1D, FLOW_LITERAL, 1, {NONE, .324, NONE, .038, NONE, {NONE, NONE, NONE, NONE, NONE, NONE}}},
};
enum { METHODS = sizeof methods / sizeof *methods, WENDLAND = 0, HERMITE, CONVEX, COLLISIONS };

/* where the particles are and how fast, at the end */
typedef struct outcome {
    flow_answer answer;
    double t;
    flow_distribution d;
    int past_half, past_one; /* fluid particles beyond a wall by more than 0.5 and 1 dref */
    double deepest;          /* in dref */
    double v[BINS];          /* mean v_theta */
    double viscosity;        /* nu of the viscous flow that has these, see fit_viscosity */
    double kinetic_energy, microseconds;
} outcome;

/* ---------------------------------------------------------------- the flow */

/* The ghosts of the shaft turn with it: from where they were at the start, so that no error adds up. data: those positions. */
static void turn_shaft(flow *f)
{
    const double omega = 2 * clustering_pi * SHAFT_TURNS, c = cos(omega * f->t), s = sin(omega * f->t), *const start = (const double *)f->data;
    int i;
    for (i = f->n_fluid; i < f->n; i++) {
        const double x = start[2 * (i - f->n_fluid)], y = start[2 * (i - f->n_fluid) + 1];
        if (x * x + y * y > 0.25 * (shaft_radius + wall_radius) * (shaft_radius + wall_radius)) continue;
        f->x[i] = c * x - s * y;
        f->y[i] = s * x + c * y;
        f->vx[i] = -omega * f->y[i];
        f->vy[i] = omega * f->x[i];
    }
}

/* Fluid strictly between the walls, ghosts as far behind them as the support reaches. Returns the start positions of the ghosts, which the caller frees. */
static double *fill(flow *f)
{
    const double reach = sph_kernel_support_ratio(f->kernel) * f->h, dy = hexagonal * f->dref, m = f->state[0].rho0 * f->dref * dy;
    const int side = (int)((wall_radius + reach) / dy) + 2;
    double *start;
    int ghosts, row, column, i;
    for (ghosts = 0; ghosts < 2; ghosts++)
        for (row = -side; row <= side; row++)
            for (column = -side - 1; column <= side; column++) {
                const double x = (column + 0.5 * (row % 2 != 0)) * f->dref, y = row * dy, r = sqrt(x * x + y * y);
                const int fluid = r > shaft_radius * (1 + 1e-9) && r < wall_radius * (1 - 1e-9);
                if (!ghosts && fluid) flow_add(f, x, y, 0, m);
                if (ghosts && !fluid && r > shaft_radius - reach && r < wall_radius + reach) flow_add_ghost(f, x, y, 0, m);
            }
    start = (double *)need(NULL, (size_t)(f->n - f->n_fluid) * 2, sizeof *start);
    for (i = f->n_fluid; i < f->n; i++) {
        start[2 * (i - f->n_fluid)] = f->x[i];
        start[2 * (i - f->n_fluid) + 1] = f->y[i];
    }
    return start;
}

static int between_walls(const flow *f, double x, double y)
{
    const double r = sqrt(x * x + y * y);
    (void)f;
    return r > shaft_radius && r < wall_radius;
}

/* ---------------------------------------------------------------- how viscous is it? */

/* dv/dt = nu (v'' + v'/r - v/r^2), v = the shaft's at its radius and 0 at the wall, from rest to t; mean of v in the bins, by r. Crank-Nicolson, after one implicit step that damps the jump. */
static void viscous_flow(double nu, double t, double v_bin[BINS])
{
    enum { CELLS = 240, STEPS = 400 };
    double v[CELLS + 1] = {0}, lower[CELLS + 1], diagonal[CELLS + 1], upper[CELLS + 1], right[CELLS + 1], weight[BINS] = {0};
    const double dr = (wall_radius - shaft_radius) / CELLS, dt = t / STEPS;
    int k, s;
    v[0] = 2 * clustering_pi * SHAFT_TURNS * shaft_radius;
    for (s = 0; s < STEPS; s++) {
        const double implicit = s == 0 ? 1 : 0.5;
        for (k = 1; k < CELLS; k++) {
            const double r = shaft_radius + k * dr, a = nu * dt * (1 / (dr * dr) - 0.5 / (r * dr)), b = -nu * dt * (2 / (dr * dr) + 1 / (r * r)),
                         c = nu * dt * (1 / (dr * dr) + 0.5 / (r * dr));
            lower[k] = -implicit * a;
            diagonal[k] = 1 - implicit * b;
            upper[k] = -implicit * c;
            right[k] = v[k] + (1 - implicit) * (a * v[k - 1] + b * v[k] + c * v[k + 1]);
        }
        right[1] -= lower[1] * v[0];
        for (k = 2; k < CELLS; k++) { /* Thomas */
            const double w = lower[k] / diagonal[k - 1];
            diagonal[k] -= w * upper[k - 1];
            right[k] -= w * right[k - 1];
        }
        for (k = CELLS - 1; k > 0; k--) v[k] = (right[k] - (k < CELLS - 1 ? upper[k] * v[k + 1] : 0)) / diagonal[k];
    }
    for (k = 0; k < BINS; k++) v_bin[k] = 0;
    for (k = 0; k < CELLS; k++) { /* by area, as particles are */
        const double r = shaft_radius + (k + 0.5) * dr;
        const int bin = k * BINS / CELLS;
        v_bin[bin] += 0.5 * (v[k] + v[k + 1]) * r;
        weight[bin] += r;
    }
    for (k = 0; k < BINS; k++) v_bin[k] /= weight[k];
}

/* The nu whose flow is nearest to v, least squares: golden-section search by its logarithm. The layer at the shaft is left out: there the particles slip. */
static double fit_viscosity(const double v[BINS], double t)
{
    const double golden = 0.6180339887498949;
    double low = log(1e-5), high = log(1e-1), at[2], off[2] = {0, 0};
    int step, side, k, known = -1;
    at[0] = high - golden * (high - low);
    at[1] = low + golden * (high - low);
    for (step = 0; step < 30; step++) {
        for (side = 0; side < 2; side++) {
            double model[BINS];
            if (side == known) continue;
            viscous_flow(exp(at[side]), t, model);
            off[side] = 0;
            for (k = 1; k < BINS; k++) off[side] += (model[k] - v[k]) * (model[k] - v[k]);
        }
        if (off[0] < off[1]) {
            high = at[1];
            at[1] = at[0];
            off[1] = off[0];
            at[0] = high - golden * (high - low);
            known = 1;
        } else {
            low = at[0];
            at[0] = at[1];
            off[0] = off[1];
            at[1] = low + golden * (high - low);
            known = 0;
        }
    }
    return exp(0.5 * (low + high));
}

/* ---------------------------------------------------------------- a run */

static void measure(flow *f, outcome *o)
{
    const flow_domain square = {-wall_radius, wall_radius, -wall_radius, wall_radius};
    int count[BINS] = {0}, i, k;
    o->d = flow_measure(f, FLOW_ALL, 0, square, between_walls);
    o->past_half = o->past_one = 0;
    o->deepest = 0;
    for (k = 0; k < BINS; k++) o->v[k] = 0;
    for (i = 0; i < f->n_fluid; i++) {
        const double r = sqrt(f->x[i] * f->x[i] + f->y[i] * f->y[i]), depth = fmax(shaft_radius - r, r - wall_radius) / f->dref;
        const int bin = (int)floor((r - shaft_radius) / (wall_radius - shaft_radius) * BINS);
        o->past_half += depth > 0.5;
        o->past_one += depth > 1;
        o->deepest = fmax(o->deepest, depth);
        if (bin < 0 || bin >= BINS) continue;
        o->v[bin] += (f->x[i] * f->vy[i] - f->y[i] * f->vx[i]) / r;
        count[bin]++;
    }
    for (k = 0; k < BINS; k++) o->v[k] /= count[k] > 0 ? count[k] : 1;
    o->viscosity = fit_viscosity(o->v, f->t);
    o->kinetic_energy = flow_kinetic_energy(f);
    o->microseconds = flow_microseconds(f);
}

static outcome run(const clustering_options *c, const method *m, double p0, double dref, double smoothing, double dt, double tend)
{
    outcome o;
    char file[64];
    flow f;
    double *start;
    flow_open(&f, m->name, m->kernel, dref, smoothing * dref);
    f.dt = dt;
    f.state[0].rho0 = 1;
    f.state[0].c = 10;
    f.state[0].p0 = p0;
    f.alpha = 0.1;
    f.remedy = m->remedy;
    f.quiet = c->quiet;
    f.vtk = c->vtk ? c->out : NULL;
    flow_restarts(&f, c, NULL, 0);
    f.data = start = fill(&f);
    f.after = turn_shaft;
    turn_shaft(&f);
    flow_snapshot(&f, c->figures, "clustering_shaft_initial"); /* the same for all; and a folder that is not there is met at once */
    o.answer = flow_run(&f, tend);
    if (o.answer == FLOW_INTERRUPTED) flow_require(&f, o.answer);
    o.t = f.t;
    measure(&f, &o);
    snprintf(file, sizeof file, "clustering_fig6_%s", m->file);
    flow_snapshot(&f, c->figures, file);
    flow_close(&f);
    free(start);
    return o;
}

/* ---------------------------------------------------------------- the table */

static void info(report *r, const char *setting, const char *quantity, double measured, double known)
{
    char criterion[REPORT_CRITERION] = "";
    if (!isnan(known)) snprintf(criterion, sizeof criterion, "independent program: %g", known);
    report_number_row(r, "Figure 6", setting, quantity, NONE, measured, criterion, NULL, REPORT_INFO);
}

static void table(report *r, const method *m, const outcome *o)
{
    char text[96], known[REPORT_CRITERION] = "";
    const double *v = o->v, *e = m->e.v;
    if (o->answer != FLOW_DONE) info(r, m->name, "blew up at t", o->t, NONE);
    info(r, m->name, "mean distance to the nearest / dref", o->d.mean, m->e.mean);
    info(r, m->name, "least distance / dref", o->d.least, NONE);
    info(r, m->name, "f(<0.5)", o->d.below_50, m->e.below_50);
    info(r, m->name, "f(<0.75)", o->d.below_75, m->e.below_75);
    info(r, m->name, "void: area farther than 0.85 dref from any", o->d.void_share, m->e.void_share);
    info(r, m->name, "deepest in a wall / dref", o->deepest, m->e.deepest);
    info(r, m->name, "particles deeper than 0.5 dref", o->past_half, NONE);
    info(r, m->name, "particles deeper than 1 dref", o->past_one, NONE);
    info(r, m->name, "kinetic energy [J/m]", o->kinetic_energy, NONE);
    snprintf(text, sizeof text, "%.2f %.2f %.2f %.2f %.2f %.2f", v[0], v[1], v[2], v[3], v[4], v[5]);
    if (!isnan(e[0])) snprintf(known, sizeof known, "independent program: %.2f %.2f %.2f %.2f %.2f %.2f", e[0], e[1], e[2], e[3], e[4], e[5]);
    report_row(r, "Figure 6", m->name, "v_theta in six rings [m/s]", NULL, text, known, NULL, REPORT_INFO);
    info(r, m->name, "nu of the viscous flow nearest to these [m2/s]", o->viscosity, NONE);
    info(r, m->name, "CPU time of a particle and step [us]", o->microseconds, NONE);
}

/* What the paper says about the pictures, and what is needed for them to say it. */
static void judge(report *r, const outcome *o)
{
    char text[96];
    int k;
    report_section(r, "Section V.III: what is said about figure 6");
    report_range(r, "Figure 6", "(3.9)", "'far less clustering': f(<0.5)", NONE, o[CONVEX].d.below_50, 0, 0.05);
    report_range(r, "Figure 6", "(1.1) + collisions", "'the distribution is much better': f(<0.75)", NONE, o[COLLISIONS].d.below_75, 0, 0);
    for (k = CONVEX; k <= COLLISIONS; k++) {
        report_range(r, "Figure 6", methods[k].name, "'no particles have left the domain': deepest in a wall / dref", NONE, o[k].deepest, 0, 1);
        report_range(r, "Figure 6", methods[k].name, "particles deeper than 0.5 dref", NONE, o[k].past_half, 0, 5);
    }
    for (k = WENDLAND; k <= HERMITE; k++) {
        snprintf(text, sizeof text, "%d past a wall by more than dref, %d by half, f(<0.5) = %.3f, void %.3f", o[k].past_one, o[k].past_half, o[k].d.below_50,
                 o[k].d.void_share);
        report_claim(r, "Figure 6", methods[k].name, "'many are clustering, leaving large voids, others have even left'", "picture", text,
                     "some deeper than 1 dref or more than 5 deeper than half, f(<0.5) > 0.2, more void than with remedies",
                     (o[k].past_one > 0 || o[k].past_half > 5) && o[k].d.below_50 > 0.2 &&
                         o[k].d.void_share > fmax(o[CONVEX].d.void_share, o[COLLISIONS].d.void_share));
    }
    snprintf(text, sizeof text, "void %.3f and f(<0.5) %.3f with (3.7), %.3f and %.3f with (1.1)", o[HERMITE].d.void_share, o[HERMITE].d.below_50,
             o[WENDLAND].d.void_share, o[WENDLAND].d.below_50);
    report_claim(r, "Figure 6", "caption: (3.7), elsewhere (1.1)", "which kernel has the voids of the top picture", "(3.7)", text, "more with (3.7)",
                 o[HERMITE].d.void_share > o[WENDLAND].d.void_share && o[HERMITE].d.below_50 > o[WENDLAND].d.below_50);
    snprintf(text, sizeof text, "nu = %.2g (1.1), %.2g (3.9), %.2g with collisions; air: 1.5e-5", o[WENDLAND].viscosity, o[CONVEX].viscosity,
             o[COLLISIONS].viscosity);
    report_row(r, "Section V.III", "velocities", "'they may cause our flow to be less realistic'", NULL, text, NULL,
               "collisions act as viscosity; but clustered particles transport least, and none of these flows is that of air", REPORT_INFO);
}

/* beside the paper's; with p0, the ghosts have it, too */
static void kernels(report *r, const clustering_options *c, double dt)
{
    static const double background[] = {0, 100}; /* 0, rho0 c^2 */
    int p, k;
    report_section(r, "Kernels beside the paper's");
    for (p = 0; p < 2; p++)
        for (k = 0; k < CLUSTERING_KERNELS; k++) {
            method m = {NULL, "kernels", SPH_WENDLAND_C2_1D, FLOW_NO_COLLISIONS, 0, {NONE, NONE, NONE, NONE, NONE, {NONE, NONE, NONE, NONE, NONE, NONE}}};
            char at[96], text[160];
            outcome o;
            m.kernel = clustering_kernels[k];
            m.name = sph_kernel_name(m.kernel);
            o = run(c, &m, background[p], 0.005, 1.5, dt, 0.5);
            snprintf(at, sizeof at, "%s, p0 = %g", m.name, background[p]);
            snprintf(text, sizeof text, "%s%.3f, %.3f, %.3f; %.4f; %d, %d (%.2f); %.2g", o.answer == FLOW_DONE ? "" : "blew up: ", o.d.mean, o.d.below_50,
                     o.d.below_75, o.d.void_share, o.past_half, o.past_one, o.deepest, o.viscosity);
            report_row(r, "kernel", at, "nnd mean, f(<.5), f(<.75); void; deeper than .5, 1 dref (deepest); nu", NULL, text, NULL, NULL, REPORT_INFO);
        }
}

int main(int argc, char **argv)
{
    clustering_options c = clustering_defaults();
    const option_spec specs[] = {CLUSTERING_OPTIONS(c), {"continue", CLUSTERING_CONTINUE, OPTION_FLAG, &c.go_on, 0, 0}};
    static report r;
    outcome o[METHODS];
    double dt;
    char text[96];
    int k;
    options_parse(argc, argv, "Figure 6 of the paper on particle clustering: air around a rotating shaft.", specs,
                  (int)(sizeof specs / sizeof *specs));
    dt = clustering_choose(c.dt, c.full ? 1e-6 : 2e-5);
    report_open(&r, "clustering_shaft", c.out);
    snprintf(text, sizeof text, "Figure 6: air around a rotating shaft, dt = %g (paper: 1e-6)", dt);
    report_section(&r, text);
    if (c.kernel) {
        method own = {c.kernel, "own", SPH_WENDLAND_C2_1D, FLOW_NO_COLLISIONS, 0, {NONE, NONE, NONE, NONE, NONE, {NONE, NONE, NONE, NONE, NONE, NONE}}};
        own.kernel = clustering_kernel(&c);
        own.remedy = clustering_remedy(&c);
        o[0] = run(&c, &own, 0, clustering_choose(c.dref, 0.005), clustering_choose(c.h, 1.5), dt, clustering_choose(c.tend, 0.5));
        table(&r, &own, &o[0]);
        return report_close(&r) ? 1 : 0;
    }
    if (c.full || c.kernels) kernels(&r, &c, clustering_choose(c.dt, 1e-5));
    if (c.kernels) return report_close(&r) ? 1 : 0;
    for (k = 0; k < METHODS; k++) {
        if (methods[k].full_only && !c.full) continue;
        o[k] = run(&c, &methods[k], 0, 0.005, 1.5, dt, 0.5);
        table(&r, &methods[k], &o[k]);
    }
    judge(&r, o);
    return report_close(&r) ? 1 : 0;
}
