/* SPDX-License-Identifier: MIT
 *
 * cleaning_shocktube.c - beyond the paper on divergence cleaning: the shock tube of Brio & Wu (1988, J. Comput. Phys. 75, 400) in two and three dimensions. Does all of SPMHD together converge to the solution?
 *
 *     cc -O2 -o cleaning_shocktube examples/papers/cleaning_shocktube.c -lm
 *     cleaning_shocktube -out DIR -figures DIR [-full]       (-h for help)
 *
 * gamma = 2; rho, P, By = 1, 1, 1 on the left of x = 0 and 1/8, 1/10, -1 on its right, Bx = 3/4, at rest; until t = 0.1. Particles of one mass on lattices, periodic across the tube: triangles in 2D (17 rows
 * on the left, 6 on the right: 8 times the area each to 0.4 %, which the spacing along the tube corrects), cubes of dx and 2 dx in 3D. Nothing is smoothed. Particles at both ends, which no wave reaches, do not move.
 * The other solution: finite volumes in 1D, HLL fluxes, limited slopes, until more cells change it little. It has the compound wave that every method with dissipation finds here.
 */
#include "../common/tube.h"
#include "cleaning.h"

enum { SIDE_L, SIDE_R };
static const double Bx0 = 0.75, end = 0.1;
static const tube brio_wu = {2, {1, 0.125}, {1, 0.1}, {{0.75, 1}, {0.75, -1}}, {-0.3, 0.45}, 0};
static const double judged[2] = {-0.25, 0.4}; /* where errors are taken */

enum { DENSITY, VELOCITY_X, VELOCITY_Y, FIELD_Y, PRESSURE, QUANTITIES };
static const char *const name_of[QUANTITIES] = {"density", "vx", "vy", "By", "pressure"};

/* ---------------------------------------------------------------- finite volumes */

enum { MASS, MOMENTUM_X, MOMENTUM_Y, INDUCTION, ENERGY };
typedef struct volumes {
    int n;
    double (*q)[QUANTITIES]; /* density, vx, vy, By, P of cells on [-1/2, 1/2] */
} volumes;

static void conserved(const double q[QUANTITIES], double u[QUANTITIES])
{
    u[MASS] = q[DENSITY];
    u[MOMENTUM_X] = q[DENSITY] * q[VELOCITY_X];
    u[MOMENTUM_Y] = q[DENSITY] * q[VELOCITY_Y];
    u[INDUCTION] = q[FIELD_Y];
    u[ENERGY] = q[PRESSURE] / (brio_wu.gamma - 1) + 0.5 * q[DENSITY] * (q[VELOCITY_X] * q[VELOCITY_X] + q[VELOCITY_Y] * q[VELOCITY_Y]) +
                0.5 * (Bx0 * Bx0 + q[FIELD_Y] * q[FIELD_Y]);
}
static void primitive(const double u[QUANTITIES], double q[QUANTITIES])
{
    q[DENSITY] = u[MASS];
    q[VELOCITY_X] = u[MOMENTUM_X] / u[MASS];
    q[VELOCITY_Y] = u[MOMENTUM_Y] / u[MASS];
    q[FIELD_Y] = u[INDUCTION];
    q[PRESSURE] = (brio_wu.gamma - 1) * (u[ENERGY] - 0.5 * u[MASS] * (q[VELOCITY_X] * q[VELOCITY_X] + q[VELOCITY_Y] * q[VELOCITY_Y]) -
                                        0.5 * (Bx0 * Bx0 + u[INDUCTION] * u[INDUCTION]));
}
static void flux(const double q[QUANTITIES], double f[QUANTITIES])
{
    const double vx = q[VELOCITY_X], vy = q[VELOCITY_Y], By = q[FIELD_Y], total = q[PRESSURE] + 0.5 * (Bx0 * Bx0 + By * By);
    double u[QUANTITIES];
    conserved(q, u);
    f[MASS] = u[MOMENTUM_X];
    f[MOMENTUM_X] = u[MOMENTUM_X] * vx + total - Bx0 * Bx0;
    f[MOMENTUM_Y] = u[MOMENTUM_Y] * vx - Bx0 * By;
    f[INDUCTION] = By * vx - Bx0 * vy;
    f[ENERGY] = (u[ENERGY] + total) * vx - Bx0 * (Bx0 * vx + By * vy);
}
static double fast_speed(const double q[QUANTITIES])
{
    sph_vec B = {0, 0, 0};
    B.x = Bx0;
    B.y = q[FIELD_Y];
    return sph_mhd_fast_speed(sqrt(brio_wu.gamma * q[PRESSURE] / q[DENSITY]), B, q[DENSITY], Bx0);
}
/* Harten, Lax & van Leer 1983 */
static void flux_hll(const double l[QUANTITIES], const double r[QUANTITIES], double f[QUANTITIES])
{
    const double cl = fast_speed(l), cr = fast_speed(r);
    const double sl = fmin(0, fmin(l[VELOCITY_X] - cl, r[VELOCITY_X] - cr)), sr = fmax(0, fmax(l[VELOCITY_X] + cl, r[VELOCITY_X] + cr));
    double ul[QUANTITIES], ur[QUANTITIES], fl[QUANTITIES], fr[QUANTITIES];
    int k;
    conserved(l, ul);
    conserved(r, ur);
    flux(l, fl);
    flux(r, fr);
    for (k = 0; k < QUANTITIES; k++) f[k] = (sr * fl[k] - sl * fr[k] + sl * sr * (ur[k] - ul[k])) / (sr - sl);
}
static double slope(double left, double right) /* van Leer's harmonic mean */ { return left * right > 0 ? 2 * left * right / (left + right) : 0; }
/* Hancock's steps: half a step of each cell from its own slopes, then one of the fluxes between cells */
static volumes volumes_new(int n)
{
    const double dx = 1.0 / n;
    volumes v;
    double(*half)[2][QUANTITIES] = (double(*)[2][QUANTITIES])need_zeros((size_t)n, sizeof *half);
    double t = 0;
    int i, k, s;
    v.n = n;
    v.q = (double(*)[QUANTITIES])need_zeros((size_t)n, sizeof *v.q);
    for (i = 0; i < n; i++) {
        s = i < n / 2 ? SIDE_L : SIDE_R;
        v.q[i][DENSITY] = brio_wu.rho[s];
        v.q[i][PRESSURE] = brio_wu.P[s];
        v.q[i][FIELD_Y] = brio_wu.B[s][1];
    }
    while (t < end) {
        double fastest = 0, dt, before[QUANTITIES] = {0};
        for (i = 0; i < n; i++) fastest = fmax(fastest, fabs(v.q[i][VELOCITY_X]) + fast_speed(v.q[i]));
        dt = fmin(0.4 * dx / fastest, end - t);
        for (i = 0; i < n; i++) {
            double edge[2][QUANTITIES], f[2][QUANTITIES], u[QUANTITIES];
            for (k = 0; k < QUANTITIES; k++) {
                const double d = i > 0 && i < n - 1 ? 0.5 * slope(v.q[i][k] - v.q[i - 1][k], v.q[i + 1][k] - v.q[i][k]) : 0;
                edge[0][k] = v.q[i][k] - d;
                edge[1][k] = v.q[i][k] + d;
            }
            for (s = 0; s < 2; s++) flux(edge[s], f[s]);
            for (s = 0; s < 2; s++) {
                conserved(edge[s], u);
                for (k = 0; k < QUANTITIES; k++) u[k] -= 0.5 * dt / dx * (f[1][k] - f[0][k]);
                primitive(u, half[i][s]);
            }
        }
        for (i = 0; i < n; i++) { /* nothing happens at the ends */
            double after[QUANTITIES] = {0}, u[QUANTITIES];
            if (i < n - 1) flux_hll(half[i][1], half[i + 1][0], after);
            conserved(v.q[i], u);
            for (k = 0; k < QUANTITIES && i > 0 && i < n - 1; k++) u[k] -= dt / dx * (after[k] - before[k]);
            primitive(u, v.q[i]);
            memcpy(before, after, sizeof before);
        }
        t += dt;
    }
    free(half);
    return v;
}
static void volumes_close(volumes *v) { free(v->q); }
/* between the middles of cells */
static double volumes_at(const volumes *v, double x, int k)
{
    const double place = fmin(fmax((x + 0.5) * v->n - 0.5, 0), v->n - 1.001);
    const int i = (int)place;
    return v->q[i][k] + (place - i) * (v->q[i + 1][k] - v->q[i][k]);
}
/* Mean of |difference| where errors are taken */
static double volumes_apart(const volumes *a, const volumes *b, int k)
{
    enum { POINTS = 20000 };
    double sum = 0;
    int i;
    for (i = 0; i < POINTS; i++) {
        const double x = judged[0] + (i + 0.5) * (judged[1] - judged[0]) / POINTS;
        sum += fabs(volumes_at(a, x, k) - volumes_at(b, x, k)) / POINTS;
    }
    return sum;
}

/* ---------------------------------------------------------------- the tube of particles */

typedef struct outcome {
    int n;
    long steps;
    double cpu, particle_steps;
    double error[QUANTITIES]; /* L1, of the volume */
    double plateau[QUANTITIES][4];
    double Bx, kink;           /* |Bx - 3/4|: mean, largest */
    gas_sums sums, worst;      /* at the end; the largest of errors over all steps */
    double energy, unbalanced; /* relative change of the energy; what leaving out (25) made of it, absolute values of rates, relative */
} outcome;

/* where the states between the waves are at the end: behind the rarefaction on the left, left and right of the contact discontinuity, before the rarefaction on the right */
static const double between[4][2] = {{-0.065, -0.045}, {0.025, 0.045}, {0.08, 0.125}, {0.2, 0.28}};

static double value(const gas *g, int k, int i)
{
    static const int which[QUANTITIES] = {RHO, VX, VY, BY, P};
    return g->a[which[k]][i];
}
static void judge(const gas *g, const volumes *v, outcome *o)
{
    double volume = 0, in[4] = {0, 0, 0, 0};
    int i, k, s;
    for (i = 0; i < g->free; i++) {
        const double x = g->a[X][i], V = g->a[M][i] / g->a[RHO][i];
        if (x < judged[0] || x > judged[1]) continue;
        volume += V;
        o->Bx += V * fabs(g->a[BX][i] - Bx0);
        o->kink = fmax(o->kink, fabs(g->a[BX][i] - Bx0));
        for (k = 0; k < QUANTITIES; k++) o->error[k] += V * fabs(value(g, k, i) - volumes_at(v, x, k));
        for (s = 0; s < 4; s++)
            if (x > between[s][0] && x < between[s][1]) {
                in[s] += V;
                for (k = 0; k < QUANTITIES; k++) o->plateau[k][s] += V * value(g, k, i);
            }
    }
    o->Bx /= volume;
    for (k = 0; k < QUANTITIES; k++) {
        o->error[k] /= volume;
        for (s = 0; s < 4; s++) o->plateau[k][s] /= in[s];
    }
}

typedef struct setting {
    const char *name;
    int dim;
    double dx;
    int cleans, still;
    double alpha_u, alpha_B, tensile;
} setting;

static outcome run(const setting *c, const volumes *v, FILE *profile, int quiet)
{
    const clock_t start = clock();
    char label[96];
    gas g = tube_new(&brio_wu, c->dim, c->dx);
    double energy;
    outcome o;
    progress p;
    int i, k;
    memset(&o, 0, sizeof o);
    snprintf(label, sizeof label, "%s, %dD, dx = 1/%.0f", c->name, c->dim, 1 / c->dx);
    g.run = label;
    g.cleans = c->cleans;
    g.still = c->still;
    g.alpha_B = c->alpha_B;
    g.tensile = c->tensile;
    gas_magnetise(&g);
    g.parts = c->dim;
    g.alpha_u = c->alpha_u;
    for (i = 0; i < g.n; i++) g.a[ALPHA][i] = g.alpha[1];
    progress_begin(&p, label, quiet);
    gas_start(&g);
    energy = gas_measure(&g).total;
    while (g.t < end) {
        const double dt = fmin(gas_longest_step(&g, 0.8), end - g.t);
        gas_step(&g, dt);
        if (end - g.t < 1e-12) g.t = end;
        o.sums = gas_measure(&g);
        o.worst.error = fmax(o.worst.error, o.sums.error);
        o.worst.largest = fmax(o.worst.largest, o.sums.largest);
        o.unbalanced += dt * fabs(g.left) / energy;
        o.steps++;
        progress_update(&p, g.t / end);
    }
    progress_end(&p);
    judge(&g, v, &o);
    o.n = g.free;
    o.energy = o.sums.total / energy - 1;
    o.particle_steps = g.particle_steps;
    if (profile)
        for (i = 0; i < g.free; i++) {
            fprintf(profile, "\"%s\",%d,%.0f,%.6g", c->name, c->dim, 1 / c->dx, g.a[X][i]);
            for (k = 0; k < QUANTITIES; k++) fprintf(profile, ",%.6g", value(&g, k, i));
            fprintf(profile, ",%.6g,%.6g\n", g.a[BX][i], g.a[DIV_B][i]);
        }
    gas_close(&g);
    o.cpu = (double)(clock() - start) / CLOCKS_PER_SEC;
    return o;
}

/* ---------------------------------------------------------------- what is reported */

static const char *text_of(const char *format, const char *word, double a)
{
    static char text[4][96];
    static int turn;
    turn = (turn + 1) % 4;
    snprintf(text[turn], sizeof text[turn], format, word, a);
    return text[turn];
}

static double middle(int state) { return 0.5 * (between[state][0] + between[state][1]); }

/* The other solution: against values that Price (exact_mhdshock.f90 of the public plotter SPLASH) read off the figures of Balsara 1998 (ApJS 116, 133), against what holds across each wave, and against itself */
static void solution(report *r, const volumes *v, const volumes *coarse)
{
    static const char *const place[4] = {"behind the left rarefaction", "left of the contact", "right of the contact", "before the right rarefaction"};
    static const double read_off[QUANTITIES][4] = {{0.675, 0.7, 0.234, 0.115},
                                                   {0.635, 0.595, 0.595, -0.24},
                                                   {-0.23, -1.58, -1.58, -0.165},
                                                   {2.1 / 3.5449, -1.9 / 3.5449, -1.9 / 3.5449, -3.25 / 3.5449},
                                                   {0.45, 0.52, 0.52, 0.08}};
    double q[4][QUANTITIES], apart = 0, speed[3], least, most;
    int k, s;
    report_section(r, "The other solution: finite volumes in 1D");
    for (s = 0; s < 4; s++)
        for (k = 0; k < QUANTITIES; k++) {
            q[s][k] = volumes_at(v, middle(s), k);
            report_absolute(report_beside(r, REPORT_OTHERS), "solution", place[s], text_of("%s (Balsara 1998, by ruler)", name_of[k], 0), read_off[k][s], q[s][k], 0.015);
        }
    for (s = 0; s < 2; s++)
        report_relative(report_beside(r, REPORT_THEORY), "solution", s ? place[3] : place[0], "P / rho^gamma: a rarefaction keeps it", brio_wu.P[s] / pow(brio_wu.rho[s], brio_wu.gamma),
                        q[3 * s][PRESSURE] / pow(q[3 * s][DENSITY], brio_wu.gamma), 2e-3);
    for (k = VELOCITY_X; k < QUANTITIES; k++) apart = fmax(apart, fabs(q[1][k] - q[2][k]));
    report_absolute(report_beside(r, REPORT_THEORY), "solution", "contact", "largest jump of vx, vy, By, P", 0, apart, 1e-3);
    /* the slow shock on the right: its speed by mass, momentum across and induction */
    for (k = 0; k < 3; k++) {
        static const int which[3] = {MASS, MOMENTUM_Y, INDUCTION};
        double u[2][QUANTITIES], f[2][QUANTITIES];
        for (s = 0; s < 2; s++) {
            conserved(q[2 + s], u[s]);
            flux(q[2 + s], f[s]);
        }
        speed[k] = (f[1][which[k]] - f[0][which[k]]) / (u[1][which[k]] - u[0][which[k]]);
    }
    least = fmin(speed[0], fmin(speed[1], speed[2]));
    most = fmax(speed[0], fmax(speed[1], speed[2]));
    report_range(report_beside(r, REPORT_THEORY), "solution", "slow shock", "its speed by the jumps of mass, momentum, By: largest / least", 1, most / least, 1, 1.005);
    for (k = 0; k < QUANTITIES; k++) {
        char text[96];
        snprintf(text, sizeof text, "%d and %d cells", coarse->n, v->n);
        report_range(r, "solution", text, text_of("L1 between them, %s", name_of[k], 0), (double)NAN, volumes_apart(v, coarse, k), 0, 5e-3);
    }
}

static void errors(report *r, const char *item, const char *at, const outcome *o)
{
    char text[160];
    snprintf(text, sizeof text, "density %.4f, vx %.4f, vy %.4f, By %.4f, P %.4f", o->error[DENSITY], o->error[VELOCITY_X], o->error[VELOCITY_Y],
             o->error[FIELD_Y], o->error[PRESSURE]);
    report_row(r, item, at, "L1", NULL, text, NULL, NULL, REPORT_INFO);
}
static void divergence(report *r, const char *item, const char *at, const outcome *o)
{
    char text[160];
    snprintf(text, sizeof text, "mean %.2e (largest of all times %.2e), largest %.2e; |Bx - 3/4|: mean %.2e, largest %.2e", o->sums.error, o->worst.error,
             o->sums.largest, o->Bx, o->kink);
    report_row(r, item, at, "h |div B| / |B|", NULL, text, NULL, NULL, REPORT_INFO);
}

enum { MOST = 4 };
/* The same at finer and finer dx, the whole set with cleaning. In 3D the compound wave and the state behind it are a few columns wide: errors fall, but have no order yet. */
static void convergence(report *r, int dim, const int *columns, int count, const volumes *v, FILE *profile, outcome *o, int quiet)
{
    const char *const item = dim == 2 ? "2D" : "3D";
    int a, k;
    report_section(r, dim == 2 ? "2D: all of SPMHD, alpha in [0.1, 1], beta = 2, alpha_u = 1, alpha_B = 0.3, (9), cleaning with sigma = 0.3"
                               : "3D: the same, sigma = 1");
    for (a = 0; a < count; a++) {
        const setting c = {"cleaning", dim, 1.0 / columns[a], 1, 0, 1, 0.3, 1};
        const char *const at = text_of("%sdx = 1/%.0f on the left", "", columns[a]);
        o[a] = run(&c, v, profile, quiet);
        report_info(r, item, at, "particles", o[a].n);
        errors(r, item, at, &o[a]);
        divergence(r, item, at, &o[a]);
        report_info(r, item, at, "total energy, relative change: what (9) does", o[a].energy);
        report_info(r, item, at, "CPU us per particle and evaluation", 1e6 * o[a].cpu / o[a].particle_steps);
    }
    for (a = 0; a + 1 < count; a++) {
        char at[96];
        snprintf(at, sizeof at, "dx = 1/%d and 1/%d", columns[a], columns[a + 1]);
        for (k = 0; k < QUANTITIES; k++)
            report_range(r, item, at, text_of("order of L1, %s", name_of[k], 0), (double)NAN,
                         log(o[a].error[k] / o[a + 1].error[k]) / log((double)columns[a + 1] / columns[a]), dim == 2 ? 0.3 : 0, HUGE_VAL);
        report_range(r, item, at, "|change of the total energy|, finer / coarser", (double)NAN, fabs(o[a + 1].energy / o[a].energy), 0, 1);
    }
}
/* The states between the waves, of the finest run */
static void states(report *r, const outcome *o, int columns, const volumes *v)
{
    static const double scale[QUANTITIES] = {1, 0.64, 1.58, 1, 1}; /* the largest of each */
    int k, s;
    for (s = 0; s < 4; s++)
        for (k = 0; k < QUANTITIES; k++) {
            char text[96];
            if (s == 1 && k == DENSITY) continue; /* too narrow: between the compound wave and the contact, both of which are smoothed */
            snprintf(text, sizeof text, "mean %s for x in [%g, %g]", name_of[k], between[s][0], between[s][1]);
            report_absolute(report_beside(r, REPORT_THEORY), "2D", text_of("%sdx = 1/%.0f, beside the other solution", "", columns), text, volumes_at(v, middle(s), k), o->plateau[k][s],
                            0.05 * scale[k]);
        }
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0, quiet = 0, a, k;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "finer particles: 1/800 in 2D, 1/96 in 3D; 6400 volumes", OPTION_FLAG, &full, 0, 0},
        {"quiet", "no line of progress", OPTION_FLAG, &quiet, 0, 0},
        THREADS_OPTION,
    };
    static const int columns[2][MOST] = {{100, 200, 400, 800}, {32, 48, 96, 0}};
    static const setting other[] = {{"without cleaning", 2, 1.0 / 200, 0, 0, 1, 0.3, 1},
                                    {"alpha_B = 1", 2, 1.0 / 200, 1, 0, 1, 1, 1},
                                    {"no resistivity", 2, 1.0 / 200, 1, 0, 1, 0, 1},
                                    {"neither resistivity nor cleaning", 2, 1.0 / 200, 0, 0, 1, 0, 1},
                                    {"no resistivity; without (25)", 2, 1.0 / 200, 1, 1, 1, 0, 1},
                                    {"no conductivity", 2, 1.0 / 200, 1, 0, 0, 0.3, 1},
                                    {"without (9)", 2, 1.0 / 200, 1, 0, 1, 0.3, 0}};
    enum { UNCLEANED, RESISTIVE, IDEAL, IDEAL_UNCLEANED, IDEAL_STILL, ADIABATIC, TENSILE, OTHERS };
    static report r;
    static outcome o[2][MOST], p[OTHERS];
    volumes v, coarse;
    FILE *profile;
    options_parse(argc, argv, "The shock tube of Brio & Wu by all of SPMHD, with and without divergence cleaning.", specs, 5);
    report_open(&r, "cleaning_shocktube", out);
    figure_folder(figures, "cleaning_shocktube");
    v = volumes_new(full ? 6400 : 3200);
    coarse = volumes_new(v.n / 2);
    profile = figure_open(figures, "cleaning_shocktube_profiles");
    fprintf(profile, "run,dim,columns,x,density,vx,vy,By,pressure,Bx,div_B\n");
    for (a = 0; a < v.n; a++)
        fprintf(profile, "\"volumes\",1,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,0\n", v.n, (a + 0.5) / v.n - 0.5, v.q[a][DENSITY], v.q[a][VELOCITY_X],
                v.q[a][VELOCITY_Y], v.q[a][FIELD_Y], v.q[a][PRESSURE], Bx0);
    solution(&r, &v, &coarse);
    convergence(&r, 2, columns[0], full ? 4 : 3, &v, profile, o[0], quiet);
    states(&r, &o[0][full ? 3 : 2], columns[0][full ? 3 : 2], &v);

    report_section(&r, "2D, dx = 1/200: what each part does");
    for (k = 0; k < OTHERS; k++) {
        p[k] = run(&other[k], &v, k == IDEAL_UNCLEANED ? profile : NULL, quiet);
        errors(&r, "parts", other[k].name, &p[k]);
        divergence(&r, "parts", other[k].name, &p[k]);
    }
    report_info(&r, "(9)", "left out", "total energy, relative change", p[TENSILE].energy);
    report_range(&r, "cleaning", "alpha_B = 0.3", "mean h |div B| / |B|, without / with", (double)NAN, p[UNCLEANED].sums.error / o[0][1].sums.error, 1,
                 HUGE_VAL);
    report_range(&r, "cleaning", "no resistivity", "mean h |div B| / |B|, without / with", (double)NAN, p[IDEAL_UNCLEANED].sums.error / p[IDEAL].sums.error, 2,
                 HUGE_VAL);
    report_range(&r, "cleaning", "no resistivity", "largest h |div B| / |B|, without / with", (double)NAN,
                 p[IDEAL_UNCLEANED].sums.largest / p[IDEAL].sums.largest, 2, HUGE_VAL);
    for (k = 0; k < QUANTITIES; k++)
        report_range(&r, "cleaning", "alpha_B = 0.3", text_of("L1 of %s, with / without", name_of[k], 0), (double)NAN, o[0][1].error[k] / p[UNCLEANED].error[k], 0.9,
                     1.1);
    report_info(&r, "(25)", "left out, no resistivity", "energy that this makes and takes, of the total, to t = 0.1", p[IDEAL_STILL].unbalanced);
    report_info(&r, "(25)", "left out, no resistivity", "mean h |div B| / |B|, without / with", p[IDEAL_STILL].sums.error / p[IDEAL].sums.error);
    report_info(&r, "(25)", "left out, no resistivity", "L1 of By, without / with", p[IDEAL_STILL].error[FIELD_Y] / p[IDEAL].error[FIELD_Y]);
    convergence(&r, 3, columns[1], full ? 3 : 2, &v, profile, o[1], quiet);
    figure_close(profile);
    volumes_close(&v);
    volumes_close(&coarse);
    return report_close(&r) ? 1 : 0;
}
