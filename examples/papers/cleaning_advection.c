/* SPDX-License-Identifier: MIT
 *
 * cleaning_advection.c - beyond the paper on divergence cleaning: its peak of div B, (40), in a gas that streams past, with all of SPMHD. Dedner et al. 2002, J. Comput. Phys. 175, 645, section 5.2;
 * Tricco & Price 2012, J. Comput. Phys. 231, 7214.
 *
 *     cc -O2 -o cleaning_advection examples/papers/cleaning_advection.c -lm
 *     cleaning_advection -out DIR -figures DIR [-full] [-vtk]       (-h for help)
 *
 * Periodic square of 2 x 2, rho = 1, P = 6, gamma = 5/3, v = (1, 1), B = (Bx of (40), 0, 1/sqrt(4 pi)), 50 x 50 particles of a square lattice, until t = 1, when the gas has moved by half of the box. No
 * resistivity: what div B loses, it loses to the cleaning. ch: the largest fast speed, 3.2, so that t = 1 here is ch t = 3.2 of the disc of figure 1.
 */
#include "../common/vtk.h"
#define GAS_DIM 2
#include "../common/gas.h"
#include "cleaning.h"

typedef struct plan {
    const char *name;
    int cleans;
    double sigma, overclean;
    double squeeze; /* v = (1, 1) + this times (sin pi x, sin pi y): the gas of the peak is compressed */
    int still;      /* without (25) */
    int times;      /* how many of at_time */
} plan;

enum { SOME = 3, TIMES = 5 };
static const double at_time[TIMES] = {0, 0.1, 0.25, 0.5, 1};

typedef struct outcome {
    gas_sums at[TIMES];
    double magnetic, field,
        total; /* energies, change to the end: magnetic, with that of psi, all; units of the peak's energy at the start, sum m Bx^2 / (2 rho) */
    double unbalanced, densest;    /* energy that leaving (25) out made less what it took; largest density */
    double field_rise, total_rise; /* largest rise in a step */
    double largest;                /* max |div B| of all times over the first */
    long steps;
    double cpu, particle_steps;
} outcome;

typedef struct setting {
    int side, vtk, quiet;
    const char *figures;
    FILE *history;
} setting;

static gas box_new(int side, double squeeze)
{
    gas g = gas_new(2, side * side, 5.0 / 3);
    const double dx = 2.0 / side;
    int i;
    gas_magnetise(&g);
    g.box[0] = g.box[1] = 2;
    for (i = 0; i < g.n; i++) {
        double s4;
        g.a[X][i] = (i % side + 0.5) * dx;
        g.a[Y][i] = (i / side + 0.5) * dx;
        s4 = 64 * pow(pow(g.a[X][i] - 1, 2) + pow(g.a[Y][i] - 1, 2), 2); /* (r/r0)^4, r0 = 1/sqrt(8) */
        g.a[M][i] = dx * dx;
        g.a[H][i] = CLEANING_ETA * dx;
        g.a[VX][i] = 1 + squeeze * sin(MATH_PI * g.a[X][i]);
        g.a[VY][i] = 1 + squeeze * sin(MATH_PI * g.a[Y][i]);
        g.a[U][i] = 6 / (g.gamma - 1);
        g.a[BX][i] = s4 < 1 ? (s4 - 1) * (s4 - 1) / sqrt(4 * MATH_PI) : 0;
        g.a[BZ][i] = 1 / sqrt(4 * MATH_PI);
    }
    return g;
}

static outcome run(const setting *s, const plan *c)
{
    const clock_t start = clock();
    const double end = at_time[c->times - 1];
    gas g = box_new(s->side, c->squeeze);
    gas_sums first, before;
    vtk_series series;
    outcome o;
    progress p;
    char label[96];
    double peak = 0, next_picture = 0;
    int reached = 0, i;
    memset(&o, 0, sizeof o);
    snprintf(label, sizeof label, "%s, sigma %g, ch x %g", c->name, c->sigma, c->overclean);
    g.run = label;
    g.cleans = c->cleans;
    g.sigma = c->sigma;
    g.overclean = c->overclean;
    g.still = c->still;
    g.alpha[1] = 0.1; /* the switch has nothing to do: no shocks */
    for (i = 0; i < g.n; i++) peak += 0.5 * g.a[M][i] * g.a[BX][i] * g.a[BX][i];
    vtk_series_begin(&series, s->figures, "cleaning_advection");
    progress_begin(&p, label, s->quiet);
    gas_start(&g);
    first = before = gas_measure(&g);
    for (;;) {
        double dt = gas_longest_step(&g, 0.8);
        gas_sums now = gas_measure(&g);
        if (s->history)
            fprintf(s->history, "%s,%g,%g,%.6g,%.6g,%.6g,%.6g,%.9g,%.9g,%.9g\n", c->name, c->sigma, c->overclean, g.t, now.error, now.largest, now.div_B,
                    (now.magnetic - first.magnetic) / peak, (now.magnetic + now.psi - first.magnetic) / peak, (now.total - first.total) / peak);
        o.total_rise = fmax(o.total_rise, (now.total - before.total) / peak);
        o.field_rise = fmax(o.field_rise, (now.magnetic + now.psi - before.magnetic - before.psi) / peak);
        o.largest = fmax(o.largest, now.div_B / first.div_B);
        if (s->vtk && g.t >= next_picture) {
            const vtk_field fields[] = {{"velocity", g.a[VX], g.a[VY], NULL, NULL},
                                        {"B", g.a[BX], g.a[BY], g.a[BZ], NULL},
                                        {"density", g.a[RHO], NULL, NULL, NULL},
                                        {"psi", g.a[PSI], NULL, NULL, NULL},
                                        {"div_B", g.a[DIV_B], NULL, NULL, NULL}};
            if (!vtk_series_add(&series, g.t, g.n, g.a[X], g.a[Y], NULL, fields, 5)) {
                fprintf(stderr, "cleaning_advection: a VTK file cannot be written\n");
                exit(2);
            }
            next_picture += 0.05;
        }
        before = now;
        for (i = 0; i < g.n; i++) o.densest = fmax(o.densest, g.a[RHO][i]);
        if (g.t >= at_time[reached] - 1e-12) {
            o.at[reached++] = now;
            if (reached == c->times) break;
        }
        dt = fmin(dt, at_time[reached] - g.t);
        o.unbalanced += dt * g.left / peak;
        gas_step(&g, dt);
        o.steps++;
        progress_update(&p, g.t / end);
    }
    progress_end(&p);
    vtk_series_end(&series);
    o.magnetic = (before.magnetic - first.magnetic) / peak;
    o.field = (before.magnetic + before.psi - first.magnetic) / peak;
    o.total = (before.total - first.total) / peak;
    o.particle_steps = g.particle_steps;
    gas_close(&g);
    o.cpu = (double)(clock() - start) / CLOCKS_PER_SEC;
    return o;
}

/* ---------------------------------------------------------------- what is reported */

enum {
    CONTROL,
    UNDAMPED,
    WEAK,
    OPTIMAL,
    DEFAULT,
    STRONG,
    OVERDAMPED,
    TWICE,
    FOUR_TIMES,
    SQUEEZED,
    SQUEEZED_STILL,
    SQUEEZED_UNDAMPED,
    SQUEEZED_UNDAMPED_STILL,
    CASES
};
static const plan plans[CASES] = {
    {"control", 0, 0, 1, 0, 0, TIMES},
    {"cleaning", 1, 0, 1, 0, 0, TIMES},
    {"cleaning", 1, 0.1, 1, 0, 0, TIMES},
    {"cleaning", 1, 0.2, 1, 0, 0, TIMES},
    {"cleaning", 1, 0.3, 1, 0, 0, TIMES},
    {"cleaning", 1, 0.5, 1, 0, 0, TIMES},
    {"cleaning", 1, 1, 1, 0, 0, TIMES},
    {"cleaning", 1, 0.3, 2, 0, 0, TIMES},
    {"cleaning", 1, 0.3, 4, 0, 0, SOME},
    {"squeezed", 1, 0.3, 1, 0.5, 0, TIMES},
    {"squeezed without (25)", 1, 0.3, 1, 0.5, 1, TIMES},
    {"squeezed", 1, 0, 1, 0.5, 0, TIMES},
    {"squeezed without (25)", 1, 0, 1, 0.5, 1, TIMES},
};

static void one_run(report *r, const plan *c, const outcome *o)
{
    char at[96], what[64], text[160];
    int k;
    if (c->cleans) snprintf(at, sizeof at, "sigma = %g, ch = %g fast speeds", c->sigma, c->overclean);
    else snprintf(at, sizeof at, "%s", c->name);
    for (k = 0; k < c->times; k++) {
        snprintf(what, sizeof what, "h |div B| / |B|, t = %g", at_time[k]);
        snprintf(text, sizeof text, "mean %.3e, largest %.3e; max |div B| %.3e", o->at[k].error, o->at[k].largest, o->at[k].div_B);
        report_row(r, "divergence", at, what, NULL, text, NULL, NULL, REPORT_INFO);
    }
    snprintf(what, sizeof what, "change to t = %g, of the peak's: magnetic", at_time[c->times - 1]);
    snprintf(text, sizeof text, "%+.4f; with that of psi %+.4f; total %+.4f", o->magnetic, o->field, o->total);
    report_row(r, "energy", at, what, NULL, text, NULL, NULL, REPORT_INFO);
    report_range(report_beside(r, REPORT_THEORY), "energy", at, "largest rise of magnetic and psi energy in a step, of the peak's", 0, o->field_rise, 0, 5e-4);
    if (c->cleans && c->sigma > 0) report_range(report_beside(r, REPORT_THEORY), "energy", at, "largest rise of the total energy in a step, of the peak's", 0, o->total_rise, 0, 1e-4);
    else report_info(r, "energy", at, "largest rise of the total energy in a step, of the peak's: (9) works where div B is", o->total_rise);
    report_range(r, "divergence", at, "largest max |div B| / first", (double)NAN, o->largest, 0, 1.005);
}

/* -psi div v / 2 left out: energy is made where the gas expands and taken where it is compressed; div B hardly notices. */
static void term_25(report *r, const outcome *o)
{
    static const int with[2] = {SQUEEZED, SQUEEZED_UNDAMPED}, without[2] = {SQUEEZED_STILL, SQUEEZED_UNDAMPED_STILL};
    int k;
    report_section(r, "(25) left out, in a gas that is squeezed: v = (1, 1) + (sin pi x, sin pi y) / 2");
    report_info(r, "(25)", "both", "largest density, of the first", o[SQUEEZED].densest);
    for (k = 0; k < 2; k++) {
        const outcome *const a = &o[with[k]], *const b = &o[without[k]];
        const char *const at = k ? "undamped" : "sigma = 0.3";
        report_info(r, "(25)", at, "energy that this makes, less what it takes, of the peak's: its rate", b->unbalanced);
        report_info(r, "(25)", at, "the same: total energy at t = 1, without - with", b->total - a->total);
        report_range(r, "(25)", at, "mean h |div B| / |B| at t = 0.25, without / with", (double)NAN, b->at[2].error / a->at[2].error, 0.9, 1.1);
        report_range(r, "(25)", at, "mean h |div B| / |B| at t = 1, without / with", (double)NAN, b->at[TIMES - 1].error / a->at[TIMES - 1].error, 0.8, 1.25);
    }
    report_range(r, "(25)", "undamped", "total energy, without - with, of the peak's", (double)NAN,
                 o[SQUEEZED_UNDAMPED_STILL].total - o[SQUEEZED_UNDAMPED].total, -0.2, -0.02);
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int side = 50, full = 0, vtk = 0, quiet = 0, k, best;
    char title[96];
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"side", "particles along each axis; other than 50, most rows differ", OPTION_INT, &side, 8, 1000},
        {"full", "100 x 100 particles, too", OPTION_FLAG, &full, 0, 0},
        {"vtk", "write the particles of the run with sigma = 0.3 every 0.05 (folder of the figures)", OPTION_FLAG, &vtk, 0, 0},
        {"quiet", "no line of progress", OPTION_FLAG, &quiet, 0, 0},
        THREADS_OPTION,
    };
    /* int f = 4/15, int f^2 = 64/315 of 2 pi r0^2 for f = ((r/r0)^4 - 1)^2: a round peak of Bx has half of its energy in the part with divergence, but for the mean, which has none */
    const double r0_2 = 1.0 / 8, mean = 2 * MATH_PI * r0_2 * pow(4.0 / 15, 2) / (4 * 64.0 / 315), lost = 0.5 * (1 - mean);
    static report r;
    static outcome o[CASES];
    setting s;
    options_parse(argc, argv, "A peak of div B in a stream, cleaned or not, with all of SPMHD.", specs, 7);
    report_open(&r, "cleaning_advection", out);
    figure_folder(figures, "cleaning_advection");
    s.side = side;
    s.quiet = quiet;
    s.figures = figures;
    s.history = figure_open(figures, "cleaning_advection_history");
    fprintf(s.history, "run,sigma,overcleaning,t,mean_error,largest_error,max_div_B,magnetic,magnetic_and_psi,total\n");
    snprintf(title, sizeof title, "A peak of div B in a stream, %d x %d particles", side, side);
    report_section(&r, title);
    for (k = 0; k < CASES; k++) {
        s.vtk = vtk && k == DEFAULT;
        o[k] = run(&s, &plans[k]);
        if (k < SQUEEZED) one_run(&r, &plans[k], &o[k]);
    }
    figure_close(s.history);
    s.history = NULL;
    s.vtk = 0;

    report_section(&r, "What cleaning does");
    report_relative(report_beside(&r, REPORT_THEORY), "control", "t = 1", "max |div B|, of the first: the stream carries it", 1, o[CONTROL].at[TIMES - 1].div_B / o[CONTROL].at[0].div_B,
                    5e-3);
    report_range(&r, "sigma = 0.3", "t = 1", "mean h |div B| / |B|, control / cleaning", (double)NAN,
                 o[CONTROL].at[TIMES - 1].error / o[DEFAULT].at[TIMES - 1].error, 1000, HUGE_VAL);
    for (k = best = UNDAMPED; k <= OVERDAMPED; k++)
        if (o[k].at[TIMES - 1].error < o[best].at[TIMES - 1].error) best = k;
    report_range(report_beside(&r, REPORT_OTHERS), "sigma", "least mean h |div B| / |B| at t = 1", "sigma (J. Comput. Phys. 231, 7214: 0.2 to 0.3 in 2D)", (double)NAN, plans[best].sigma,
                 0.2, 0.3);
    report_relative(report_beside(&r, REPORT_THEORY), "sigma = 0.3", "energy lost, of the peak's", "half of all but the mean: the part with divergence", lost, -o[DEFAULT].total, 0.02);
    report_relative(report_beside(&r, REPORT_THEORY), "over-cleaning", "ch doubled", "mean error at t = 0.25, of that of t = 0.5 with ch: it is all ch t", 1,
                    o[TWICE].at[2].error / o[DEFAULT].at[3].error, 0.05);
    report_range(&r, "over-cleaning", "t = 0.1", "mean h |div B| / |B|, ch / 2 ch", (double)NAN, o[DEFAULT].at[1].error / o[TWICE].at[1].error, 1, HUGE_VAL);
    report_range(&r, "over-cleaning", "t = 0.1", "mean h |div B| / |B|, ch / 4 ch", (double)NAN, o[DEFAULT].at[1].error / o[FOUR_TIMES].at[1].error, 4,
                 HUGE_VAL);
    report_info(&r, "over-cleaning", "4 ch", "steps, of those with ch", (double)o[FOUR_TIMES].steps / (double)o[DEFAULT].steps);
    term_25(&r, o);
    if (full) {
        report_section(&r, "100 x 100 particles");
        s.side = 100;
        for (k = CONTROL; k <= DEFAULT; k += DEFAULT - CONTROL) {
            o[k] = run(&s, &plans[k]);
            one_run(&r, &plans[k], &o[k]);
        }
        report_relative(report_beside(&r, REPORT_THEORY), "sigma = 0.3", "energy lost, of the peak's", "half of all but the mean: the part with divergence", lost, -o[DEFAULT].total, 0.02);
    }
    return report_close(&r) ? 1 : 0;
}
