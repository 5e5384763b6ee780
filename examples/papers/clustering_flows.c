/* SPDX-License-Identifier: MIT
 *
 * clustering_flows.c - beyond the paper on particle clustering, which ends with 'the effect of the collision concept on the macroscopic behaviour of the flow needs more investigation': viscous flows whose
 * solution is known, by the conventional kernel, the convex kernel and collisions.
 *
 *     cc -O2 -o clustering_flows examples/papers/clustering_flows.c -lm
 *     clustering_flows -out DIR -figures DIR [-full]       (-h for help)
 *
 *   Couette and Poiseuille flow between plates against their series, with the order of the error: viscosity of Morris, plates of Adami's ghosts (Morris, Fox & Zhu 1997, JCP 136, 214; Adami, Hu & Adams 2012,
 *     JCP 231, 7057).
 *   The vortices of Taylor and Green in a periodic box: how fast their energy decays, as a viscosity, beside the viscosity that was asked for; the observed order of the velocity, early and late; with and without
 *     velocity cleaning (Tricco & Price 2012).
 */
#include "../common/statistics.h"
#define FLOW_SWITCH_KERNEL(k, CALL) \
    switch (k) { /* of the methods below */ \
    case SPH_WENDLAND_C2_1D: CALL(SPH_WENDLAND_C2_1D); \
    case SPH_CONVEX: CALL(SPH_CONVEX); \
    case SPH_WENDLAND_C2: CALL(SPH_WENDLAND_C2); \
    default: return SPH_ERROR_KERNEL; \
    }
#include "clustering_plates.h"
#include "clustering_viscous.h"

typedef struct method {
    const char *name;
    sph_kernel kernel;
    int remedy;
    double p0;  /* background pressure */
    int cleans; /* velocity cleaning with ch = c */
} method;
static const method methods[] = {{"(1.1)", SPH_WENDLAND_C2_1D, FLOW_NO_COLLISIONS, 0, 0},
                                 {"(3.9)", SPH_CONVEX, FLOW_NO_COLLISIONS, 0, 0},
                                 {"(1.1) + collisions", SPH_WENDLAND_C2_1D, FLOW_SEQUENTIAL, 0, 0},
                                 {"Wendland C2", SPH_WENDLAND_C2, FLOW_NO_COLLISIONS, 0, 0},
                                 {"(1.1) with p0 = 3.2", SPH_WENDLAND_C2_1D, FLOW_NO_COLLISIONS, 3.2, 0},
                                 {"(1.1), cleaned", SPH_WENDLAND_C2_1D, FLOW_NO_COLLISIONS, 0, 1}};
enum {
    METHODS = sizeof methods / sizeof *methods,
    CONVENTIONAL = 0,
    CONVEX,
    COLLISIONS,
    BACKGROUND = METHODS - 2,
    CLEANED
};

/* ---------------------------------------------------------------- between plates */

enum { PLATE_TIMES = 3 };
static const double plate_times[PLATE_TIMES] = {0.02, 0.1, 1};

/* Root mean square error at the times, in units of the largest speed of all. profile: a line per row of particles, or null. */
static flow_answer plates(const clustering_options *c, int couette, const method *m, int rows, double *error,
                          FILE *profile, double *microseconds)
{
    const double dref = 1 / (rows * hexagonal), h = 1.5 * dref, speed_of_sound = 10;
    viscous w;
    flow_answer answer = FLOW_DONE;
    flow f;
    int i, k;
    flow_open(&f, couette ? "Couette" : "Poiseuille", m->kernel, dref, h);
    f.dt = fmin(0.25 * h / (speed_of_sound + 1), 0.125 * h * h);
    f.state[0].rho0 = 1;
    f.state[0].c = speed_of_sound;
    f.form = FLOW_CONTINUITY;
    f.rate_after_kick = 1;
    f.alpha = 0;
    f.remedy = m->remedy;
    f.quiet = c->quiet;
    plates_fill(&f, couette, rows);
    viscous_open(&w, &f, 1, plates_force(couette));
    for (k = 0; k < PLATE_TIMES && answer == FLOW_DONE; k++) {
        answer = flow_run(&f, plate_times[k]);
        error[k] = plates_error(&f, couette);
        for (i = 0; i < f.n_fluid && profile; i += PLATES_COLUMNS)
            fprintf(profile, "%s,%g,%.6g,%.6g,%.6g\n", couette ? "Couette" : "Poiseuille", plate_times[k], f.y[i],
                    f.vx[i], plates_speed(couette, f.y[i], f.t));
        if (profile) fprintf(profile, "\n"); /* gnuplot: a new line */
    }
    if (answer == FLOW_INTERRUPTED) flow_require(&f, answer);
    *microseconds = flow_microseconds(&f);
    viscous_close(&w);
    flow_close(&f);
    return answer;
}

static void between_plates(report *r, const clustering_options *c)
{
    static const int rows[] = {10, 20, 40};
    const int grids = c->full ? 3 : 2;
    part_file to;
    int couette, g, k, m;
    clustering_figure(&to, c->figures, "clustering_plates");
    fprintf(to.to, "flow,t,y,u,exact\n");
    for (couette = 0; couette < 2; couette++) {
        const char *const item = couette ? "Couette" : "Poiseuille";
        report_section(r, couette ? "Couette flow, Re = 1: against the series"
                                  : "Poiseuille flow, Re = 1: against the series");
        for (m = 0; m < BACKGROUND; m++) {
            double error[3][PLATE_TIMES], us;
            char setting[64], quantity[64];
            for (g = 0; g < grids; g++) {
                const flow_answer answer = plates(c, couette, &methods[m], rows[g], error[g],
                                                  m == CONVENTIONAL && g == 1 ? to.to : NULL, &us);
                if (answer == FLOW_BLEW_UP)
                    report_row(r, item, methods[m].name, "blew up", NULL, NULL, NULL, NULL, REPORT_DIFFERS);
            }
            for (k = 0; k < PLATE_TIMES; k++) {
                snprintf(setting, sizeof setting, "%s, t = %g", methods[m].name, plate_times[k]);
                for (g = 0; g < grids; g++) {
                    snprintf(quantity, sizeof quantity, "rms error / largest speed, %d rows", rows[g]);
                    report_info(r, item, setting, quantity, error[g][k]);
                }
                report_info(r, item, setting, "order",
                            log(error[grids - 2][k] / error[grids - 1][k]) / log(2.0));
            }
            report_range(r, item, methods[m].name, "largest rms error / largest speed, 20 rows", (double)NAN,
                         fmax(fmax(error[1][0], error[1][1]), error[1][2]), 0, 0.03);
            report_info(r, item, methods[m].name, "CPU time of a particle and step [us]", us);
        }
    }
    clustering_figure_close(&to);
}

/* ---------------------------------------------------------------- vortices of Taylor and Green */

/* Energy decays as exp(-16 pi^2 nu t) in the unit box, u = -cos(2 pi x) sin(2 pi y). Here it gives a viscosity, from the slope of its logarithm: early, while the particles are still near the lattice that they start
   from, and late. */
typedef struct vortices {
    flow_answer answer;
    double early, lattice, late, microseconds; /* lattice: what the early one ought to be */
    double early_error, late_error,
        divergence; /* rms error of velocity at t = 0.05 and 0.5; rms of div v over particles and the times after the first */
    flow_distribution d;
    int64_t collisions;
} vortices;

/* What Morris' viscosity is on the lattice, in units of nu: sum_j V F (1 - cos cos) r^2 / (r^2 + 0.01 h^2) over the wave's -k^2. */
static double lattice_viscosity(sph_kernel k, double h, double dx, double dy)
{
    const double wave = 2 * clustering_pi, eta = 0.1;
    const sph_fluid_side one = {.rho = 1, .mu = 1};
    const int reach = (int)(sph_kernel_support_ratio(k) * h / dy) + 1;
    double sum = 0;
    int row, column;
    for (row = -reach; row <= reach; row++)
        for (column = -reach; column <= reach; column++) {
            const double x = (column + 0.5 * (row % 2 != 0)) * dx, y = row * dy, r = sqrt(x * x + y * y);
            const sph_encounter pair = {.r = r, .h = h};
            if (row == 0 && column == 0) continue;
            sum -= dx * dy * sph_viscosity_mu_pair_morris(one, one, pair, sph_kernel_f(k, 2, r, h), eta) *
                   (1 - cos(wave * x) * cos(wave * y));
        }
    return sum / (2 * wave * wave);
}

/* rms over the particles */
static double velocity_error(const flow *f, double nu)
{
    const double decay = exp(-8 * clustering_pi * clustering_pi * nu * f->t);
    double sum = 0;
    int i;
    for (i = 0; i < f->n; i++) {
        const double x = 2 * clustering_pi * f->x[i], y = 2 * clustering_pi * f->y[i];
        const double ex = f->vx[i] + cos(x) * sin(y) * decay, ey = f->vy[i] - sin(x) * cos(y) * decay;
        sum += (ex * ex + ey * ey) / f->n;
    }
    return sqrt(sum);
}

static vortices taylor_green(const clustering_options *c, const method *m, int columns, double smoothing,
                             double nu, FILE *curve)
{
    enum { POINTS = 21, EARLY = 3, LATE = 10 }; /* t <= 0.05, t >= 0.25 */
    const int rows = 2 * (int)(columns / (2 * hexagonal) + 0.5);
    const double dx = 1.0 / columns, dy = 1.0 / rows, dref = sqrt(dx * dy / hexagonal), h = smoothing * dref,
                 end = 0.5, k2 = 16 * clustering_pi * clustering_pi;
    const flow_domain box = {0, 1, 0, 1};
    double t[POINTS], energy[POINTS], start;
    vortices o;
    viscous w;
    flow f;
    int row, column, i, k;
    memset(&o, 0, sizeof o);
    flow_open(&f, "Taylor-Green", m->kernel, dref, h);
    f.state[0].rho0 = 1;
    f.state[0].c = 10;
    f.state[0].p0 = m->p0;
    f.dt = fmin(0.2 * h / (f.state[0].c + 1), 0.125 * h * h / nu);
    f.box_x = f.box_y = 1;
    f.form = FLOW_SUMMATION;
    f.alpha = 0;
    f.remedy = m->remedy;
    f.quiet = c->quiet;
    for (row = 0; row < rows; row++)
        for (column = 0; column < columns; column++) {
            i = flow_add(&f, (column + 0.25 + 0.5 * (row % 2)) * dx, (row + 0.5) * dy, 0, dx * dy);
            f.vx[i] = -cos(2 * clustering_pi * f.x[i]) * sin(2 * clustering_pi * f.y[i]);
            f.vy[i] = sin(2 * clustering_pi * f.x[i]) * cos(2 * clustering_pi * f.y[i]);
        }
    viscous_open(&w, &f, nu, 0);
    if (m->cleans) viscous_clean(&w, &f, f.state[0].c);
    start = flow_kinetic_energy(&f);
    o.answer = FLOW_DONE;
    for (k = 0; k < POINTS && o.answer == FLOW_DONE; k++) {
        o.answer = flow_run(&f, end * k / (POINTS - 1));
        t[k] = f.t; /* whole steps: not quite the time that was asked for */
        energy[k] = log(flow_kinetic_energy(&f) / start);
        if (k == EARLY - 1) o.early_error = velocity_error(&f, nu);
        if (k > 0) {
            expect(flow_divergence(&f)); /* into rate */
            for (i = 0; i < f.n; i++) o.divergence += f.rate[i] * f.rate[i] / f.n / (POINTS - 1);
        }
        fprintf(curve, "\"%s\",%g,%d,%g,%.6g,%.6g\n", m->name, smoothing, columns, f.t, exp(energy[k]),
                exp(-k2 * nu * f.t));
    }
    flow_require(&f, o.answer);
    o.early = -statistics_slope(t, energy, EARLY) / k2;
    o.lattice = nu * lattice_viscosity(m->kernel, h, dx, dy);
    o.late = -statistics_slope(t + LATE, energy + LATE, POINTS - LATE) / k2;
    o.late_error = velocity_error(&f, nu);
    o.divergence = sqrt(o.divergence);
    o.d = flow_measure(&f, FLOW_ALL, 0, box, NULL);
    o.collisions = f.collisions;
    o.microseconds = flow_microseconds(&f);
    viscous_close(&w);
    flow_close(&f);
    return o;
}

/* On a lattice at h = 1.5 dref the convex kernel's density is 3.2 % too large: with p = c^2 (rho - rho0), a background pressure of 3.2 rho U^2, which sets the lattice in motion sooner. The conventional kernel with
   that pressure does the same. */
static void background_pressure(report *r, const vortices *convex, const vortices *conventional, double nu)
{
    double S, G;
    clustering_lattice(SPH_CONVEX, 1.5, &S, &G);
    report_absolute(report_beside(r, REPORT_THEORY), "Taylor-Green", "(3.9), h = 1.5 dref",
                    "c^2 (S - 1) on the lattice, and the p0 of the next row", methods[BACKGROUND].p0,
                    100 * (S - 1), 0.05);
    report_absolute(report_beside(r, REPORT_REGRESSION), "Taylor-Green", "(3.9) beside (1.1) with this pressure",
                    "viscosity / nu, t = 0 to 0.05", conventional->early / nu, convex->early / nu, 0.05);
}

static void decay(report *r, const clustering_options *c)
{
    static const int columns[] = {20, 40, 80};
    enum { GRIDS = sizeof columns / sizeof *columns, WIDTHS = 2 };
    const double nu = 0.01, smoothing[WIDTHS] = {1.5, 2};
    const int grids = c->full ? GRIDS : GRIDS - 1, last = grids - 1;
    vortices o[METHODS][WIDTHS][GRIDS];
    char text[REPORT_CRITERION];
    part_file to;
    int m, g, s;
    clustering_figure(&to, c->figures, "clustering_taylor_green");
    fprintf(to.to, "run,smoothing,columns,t,energy,exact\n");
    report_section(
        r,
        "Vortices of Taylor and Green, Re = 100, (2.2), (2.3), p0 = 0: the viscosity that their decay shows");
    for (m = 0; m < METHODS; m++)
        for (s = 0; s < (m <= CONVEX ? WIDTHS : 1); s++)
            for (g = 0; g < grids; g++) {
                const int plain = !methods[m].remedy && m < BACKGROUND &&
                                  !(m == CONVEX && s == 0); /* see background_pressure */
                const vortices *const v = &o[m][s][g];
                char setting[64];
                o[m][s][g] = taylor_green(c, &methods[m], columns[g], smoothing[s], nu, to.to);
                snprintf(setting, sizeof setting, "%s, h = %g dref, %d columns", methods[m].name,
                         smoothing[s], columns[g]);
                if (plain)
                    report_absolute(report_beside(r, REPORT_THEORY), "Taylor-Green", setting,
                                    "viscosity / nu, t = 0 to 0.05, and that of the lattice",
                                    v->lattice / nu, v->early / nu, 0.05);
                else report_info(r, "Taylor-Green", setting, "viscosity / nu, t = 0 to 0.05", v->early / nu);
                report_info(r, "Taylor-Green", setting, "viscosity / nu, t = 0.25 to 0.5", v->late / nu);
                report_info(r, "Taylor-Green", setting, "rms error of velocity at t = 0.05", v->early_error);
                report_info(r, "Taylor-Green", setting, "rms error of velocity at t = 0.5", v->late_error);
                if (g > 0)
                    report_info(r, "Taylor-Green", setting, "order of the error at t = 0.05",
                                log(v[-1].early_error / v->early_error) / log(2.0));
                if (g > 0)
                    report_info(r, "Taylor-Green", setting, "order of the error at t = 0.5",
                                log(v[-1].late_error / v->late_error) / log(2.0));
                report_info(r, "Taylor-Green", setting, "rms of div v", v->divergence);
                report_info(r, "Taylor-Green", setting, "mean distance to the nearest / dref", v->d.mean);
                report_info(r, "Taylor-Green", setting, "f(<0.5)", v->d.below_50);
                if (methods[m].remedy)
                    report_info(r, "Taylor-Green", setting, "collisions", (double)v->collisions);
                report_info(r, "Taylor-Green", setting, "CPU time of a particle and step [us]",
                            v->microseconds);
            }
    clustering_figure_close(&to);
    background_pressure(r, &o[CONVEX][0][last], &o[BACKGROUND][0][last], nu);
    report_range(r, "Taylor-Green", "(1.1), h = 1.5 dref, 20 to 40 columns",
                 "order of the error at t = 0.05, near the lattice", (double)NAN,
                 log(o[CONVENTIONAL][0][0].early_error / o[CONVENTIONAL][0][1].early_error) / log(2.0), 1.5,
                 2.5);
    for (g = 0; g < grids; g++) {
        const vortices *const plain = &o[CONVENTIONAL][0][g], *const cleaned = &o[CLEANED][0][g];
        char setting[64];
        snprintf(setting, sizeof setting, "(1.1), h = 1.5 dref, %d columns", columns[g]);
        snprintf(text, sizeof text, "rms of div v %.2f, %.2f cleaned; late viscosity / nu %.2f, %.2f",
                 plain->divergence, cleaned->divergence, plain->late / nu, cleaned->late / nu);
        report_claim(r, "cleaning", setting, "velocity cleaning reduces div v", "", text, "below 0.7 times",
                     cleaned->divergence < 0.7 * plain->divergence);
    }
    snprintf(text, sizeof text, "viscosity / nu = %.1f early, %.1f late; %.2f, %.1f without",
             o[COLLISIONS][0][last].early / nu, o[COLLISIONS][0][last].late / nu,
             o[CONVENTIONAL][0][last].early / nu, o[CONVENTIONAL][0][last].late / nu);
    report_row(r, "Section VI", "collisions, h = 1.5 dref",
               "'the effect on the macroscopic flow needs more investigation'", NULL, text, NULL,
               "lattice rows that pass each other collide: energy is lost as long as order is", REPORT_INFO);
    snprintf(text, sizeof text, "late viscosity / nu %.2f at h = 1.5 dref, %.2f at 2 dref, %d columns",
             o[CONVEX][0][last].late / nu, o[CONVEX][1][last].late / nu, columns[last]);
    report_row(r, "Section III", "(3.9)", "'can be reduced by choosing a larger smoothing scale'", NULL, text,
               NULL,
               "disorder dissipates with every method here, more the finer the lattice: the order needs more "
               "neighbours, not only more particles",
               REPORT_INFO);
}

int main(int argc, char **argv)
{
    clustering_options c = clustering_defaults();
    const option_spec specs[] = {{"out", "folder of the result table", OPTION_TEXT, &c.out, 0, 0},
                                 {"figures", "folder of the figures' data", OPTION_TEXT, &c.figures, 0, 0},
                                 {"full", "finer lattices, too", OPTION_FLAG, &c.full, 0, 0},
                                 {"quiet", "no progress on the terminal", OPTION_FLAG, &c.quiet, 0, 0},
                                 THREADS_OPTION};
    static report r;
    options_parse(argc, argv,
                  "Viscous flows with a known solution, by the methods of the paper on particle clustering.",
                  specs, (int)(sizeof specs / sizeof *specs));
    report_open(&r, "clustering_flows", c.out);
    between_plates(&r, &c);
    decay(&r, &c);
    return report_close(&r) ? 1 : 0;
}
