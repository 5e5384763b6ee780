/* SPDX-License-Identifier: MIT
 *
 * elliptic_slit.c - table 1 of the paper on the elliptic operator: start-up of the flow through a slit, explicit steps with M-SPH.
 *
 *     cc -O2 -o elliptic_slit examples/papers/elliptic_slit.c -lm
 *     elliptic_slit -out DIR -figures DIR [-full]       (-h for help)
 *
 * 11 x 11 nodes on [0, 2] x [-1, 1], dx = 0.2, boundary nodes included; Re = 1. dv/dt = 1 + L v from v = 0; v = 0 on the walls, the exact series (87) at inlet and outlet.
 * nu = dt / (Re dx^2). The error is the largest over all nodes.
 */
#define ELLIPTIC_DIM(c) 2 /* of all clouds here */
#include "../common/options.h"
#include "../common/report.h"
#include "../common/statistics.h"
#include "elliptic.h"

enum { TIMES = 10, COLUMNS = 4 };
static const double table1_nu[COLUMNS] = {0.1, 0.2, 0.25, 0.26};
static const double table1[COLUMNS][TIMES] = {
    {-3.790, -4.825, -5.894, -6.965, -8.037, -9.108, -10.180, -11.256, -12.379, -12.975},
    {-4.099, -5.137, -6.206, -7.277, -8.349, -9.420, -10.491, -11.554, -12.539, -13.019},
    {-3.699, -4.738, -5.807, -6.878, -7.950, -9.021, -10.092, -11.161, -12.195, -12.922},
    {-3.608, -3.296, -2.098, -0.900, 0.298, 1.496, 2.693, 3.891, 5.089, 6.287}};

/* (87) with Re = 1 and a forcing of 1 */
static double exact_velocity(double y, double t)
{
    double sum = 0;
    int n;
    for (n = 0; n < 400; n++) {
        const double k = 0.5 * MATH_PI * (2 * n + 1), decay = exp(-k * k * t);
        sum += (n % 2 ? -1 : 1) * cos(k * y) * decay / ((2.0 * n + 1) * (2.0 * n + 1) * (2.0 * n + 1));
        if (decay < 1e-18) break;
    }
    return 0.5 * (1 - y * y) - 16 / (MATH_PI * MATH_PI * MATH_PI) * sum;
}

/* log10 of the error at t = 1, ..., 10, and along the way */
typedef struct run {
    double at[TIMES];
    double peak; /* largest log10 error from t = 1 on */
} run;

/* The cubic through the values at steps k - 1 ... k + 2, at s in [0, 1] between k and k + 1. The paper interpolates 'by cubic splines'. */
static double cubic(const double *e, double s)
{
    return -s * (s - 1) * (s - 2) / 6 * e[0] + (s + 1) * (s - 1) * (s - 2) / 2 * e[1] -
           (s + 1) * s * (s - 2) / 2 * e[2] + (s + 1) * s * (s - 1) / 6 * e[3];
}

/* Steps of dt until t = 10; h = f dx; forcing +1 or, as (86) and (88) print it, -1. curve: a line per step, or null. */
static run integrate(cloud *c, int side, double f, double dt, double forcing, FILE *curve, double nu)
{
    const int steps = (int)(TIMES / dt) + 4;
    double *const error = (double *)need(NULL, (size_t)steps + 1, sizeof *error);
    run r;
    int step, i, k;
    cloud_lattice(c, 2, side, 0, 2.0 / (side - 1));
    for (i = 0; i < c->n; i++) c->y[i] -= 1;
    cloud_neighbours(c, f * c->dx);
    cloud_rows(c, SCHEME_M, (sph_elliptic_options){0});
    for (step = 0; step <= steps; step++) {
        const double t = step * dt;
        double worst = 0, series[64];
        if (step > 0)
            expect(sph_rows_apply(cloud_all(c), c->row, sph_scalars_none(), sph_scalars_array(c->u),
                                  sph_scalar_out_array(c->value, 0)));
        for (k = 0; k < side; k++) series[k] = exact_velocity(c->y[k * side], t);
        for (i = 0; i < c->n; i++) {
            const int column = i % side, line = i / side;
            if (line == 0 || line == side - 1) c->u[i] = 0;
            else if (column == 0 || column == side - 1) c->u[i] = series[line];
            else if (step > 0) c->u[i] += dt * (forcing + c->value[i]);
            worst = fmax(worst, fabs(c->u[i] - series[line]));
        }
        error[step] = log10(worst + 1e-300); /* 0 at the start */
        if (curve && t <= TIMES + 0.5 * dt) fprintf(curve, "%g,%g,%.9g,%.9g\n", nu, f, t, error[step]);
    }
    r.peak = -HUGE_VAL;
    for (step = 1; step <= steps; step++)
        if (step * dt >= 1) r.peak = fmax(r.peak, error[step]);
    for (k = 0; k < TIMES; k++) {
        const int below = (int)((k + 1) / dt * (1 + 1e-12));
        r.at[k] = cubic(error + below - 1, (k + 1) / dt - below);
    }
    free(error);
    return r;
}

static double step_of(double nu, int side)
{
    const double dx = 2.0 / (side - 1);
    return nu * dx * dx;
}

static const char *at_time(int k)
{
    static char text[32];
    snprintf(text, sizeof text, "log10 E at t = %d", k + 1);
    return text;
}

/* The stencil that reproduces the table: the five points of finite differences */
static void stencil(report *r, cloud *c)
{
    double worst = 0;
    sph_index p;
    int i;
    cloud_lattice(c, 2, 11, 0, 0.2);
    cloud_neighbours(c, 0.5005 * c->dx);
    cloud_rows(c, SCHEME_M, (sph_elliptic_options){0});
    for (i = 0; i < c->n; i++)
        if (c->depth[i] > 0.5 * c->dx)
            for (p = c->lists.start[i]; p < c->lists.start[i + 1]; p++)
                worst = fmax(worst, fabs(c->row[p] * c->dx * c->dx - 1));
    report_section(r, "Table 1: flow through a slit, explicit steps");
    report_absolute(report_beside(r, REPORT_THEORY), "Table 1", "rows at f = 0.5005, inside", "max |dx^2 T - 1| (five-point stencil)", 0,
                    worst, 1e-11);
}

static void table(report *r, cloud *c, const char *figures)
{
    FILE *const curve = figure_open(figures, "elliptic_table1");
    run column[COLUMNS], nine;
    char setting[64], text[96];
    double time[TIMES], growth;
    int a, k;
    fprintf(curve, "nu,f,t,log10E\n");
    for (a = 0; a < COLUMNS; a++) {
        column[a] = integrate(c, 11, 0.5005, step_of(table1_nu[a], 11), 1, curve, table1_nu[a]);
        snprintf(setting, sizeof setting, "nu = %g, f = 0.5005", table1_nu[a]);
        for (k = 0; k < TIMES; k++) {
            time[k] = k + 1;
            if (a == 3 || k < 7)
                report_absolute(r, "Table 1", setting, at_time(k), table1[a][k], column[a].at[k], 0.005);
            else
                report_range(r, "Table 1", setting, at_time(k), table1[a][k], column[a].at[k], -HUGE_VAL,
                             -11); /* the floor of round-off, which the order of sums moves */
        }
    }
    growth = log10(fabs(1 - 0.26 * 8 * cos(MATH_PI * 0.05) * cos(MATH_PI * 0.05))) / step_of(0.26, 11);
    report_absolute(
        r, "Table 1", "nu = 0.26, t = 4 to 10", "slope of log10 E (published: of the printed column)",
        statistics_slope(time + 3, table1[3] + 3, 7), statistics_slope(time + 3, column[3].at + 3, 7), 1e-3);
    report_absolute(report_beside(r, REPORT_THEORY), "Table 1", "nu = 0.26, growth of the shortest wave",
                    "slope of log10 E", growth,
                    statistics_slope(time + 3, column[3].at + 3, 7), 1e-3);

    report_section(r, "Section 4.4: what is said about table 1");
    snprintf(text, sizeof text, "largest log10 E after t = 1: %.2f, %.2f, %.2f; %.2f at 0.26", column[0].peak,
             column[1].peak, column[2].peak, column[3].peak);
    report_claim(r, "Section 4.4", "f = 0.5005", "stability", "stable for nu <= 0.25, unstable above", text,
                 "no growth up to 0.25, growth at 0.26",
                 column[0].peak < -3 && column[1].peak < -3 && column[2].peak < -3 && column[3].peak > 0);
    snprintf(text, sizeof text, "log10 E at t = 5: %.3f, %.3f, %.3f", column[0].at[4], column[1].at[4],
             column[2].at[4]);
    report_claim(r, "Section 4.4", "nu = 0.1, 0.2, 0.25", "smallest error", "around nu = 0.2", text,
                 "least of the three",
                 column[1].at[4] < column[0].at[4] && column[1].at[4] < column[2].at[4]);

    nine = integrate(c, 11, 1.0, step_of(0.26, 11), 1, curve, 0.26);
    for (k = 0; k < TIMES; k += 3)
        report_info(r, "nine points", "nu = 0.26, f = 1.0", at_time(k), nine.at[k]);
    snprintf(text, sizeof text, "log10 E = %.3f at t = 1, %.2f at t = 10 for nu = 0.26, f = 1.0", nine.at[0],
             nine.at[9]);
    report_claim_fails(r, "Section 4.4", "nine points (f = 1.0)", "stability", "'unstable for nu > 0.25'",
                       text, "the limit 1/4 belongs to the five points (f from 0.5 to 0.707)");
    figure_close(curve);
}

/* What the print leaves open or turns round */
static void misprints(report *r, cloud *c)
{
    run s = integrate(c, 11, 0.5005, step_of(0.2, 11), -1, NULL, 0);
    char text[96];
    report_section(r, "Section 4.4: misprints");
    snprintf(text, sizeof text, "log10 E = %.3f at t = 1, %.3f at t = 10: the flow runs backwards", s.at[0],
             s.at[9]);
    report_claim_fails(r, "(86), (88)", "nu = 0.2", "sign of the forcing", "-dw/L", text,
                       "(87) needs +dw/L, or dw = w1 - w2");
    /* (6): h_m is a smoothing length, here f dx */
    s = integrate(c, 11, 0.5005, step_of(0.26 * 0.5005 * 0.5005, 11), 1, NULL, 0);
    snprintf(text, sizeof text, "log10 E = %.3f at t = 1, %.2f at t = 10: stable", s.at[0], s.at[9]);
    report_claim_fails(r, "Table 1", "nu = 0.26 with dt = nu h^2, h = f dx", "h_m in nu = dt / (Re h_m^2)",
                       "smoothing length, (6)", text,
                       "the table's columns come out with the spacing dx in its place");
}

/* Time step and spacing err with opposite signs: 1/2 dt L^2 against dx^2 (d_x^4 + d_y^4) / 12, equal at nu = 1/6 for a field of y alone. */
static void best_step(report *r, cloud *c, int full)
{
    const int count = full ? 91 : 19;
    double best = HUGE_VAL, at = 0;
    int k;
    for (k = 0; k < count; k++) {
        const double nu = 0.14 + 0.09 * k / (count - 1);
        const run s = integrate(c, 11, 0.5005, step_of(nu, 11), 1, NULL, 0);
        if (s.at[4] < best) {
            best = s.at[4];
            at = nu;
        }
    }
    report_range(report_beside(r, REPORT_THEORY), "Section 4.4", "f = 0.5005, t = 5",
                 "nu of the smallest error (published: 'around 0.2')", 1.0 / 6, at, 1.0 / 6 - 0.006,
                 1.0 / 6 + 0.006);
    report_info(r, "Section 4.4", "f = 0.5005, t = 5", "log10 E there", best);
}

/* beyond the paper: half the spacing */
static void finer(report *r, cloud *c)
{
    const run coarse = integrate(c, 11, 0.5005, step_of(0.2, 11), 1, NULL, 0),
              fine = integrate(c, 21, 0.5005, step_of(0.2, 21), 1, NULL, 0);
    report_range(r, "beyond", "nu = 0.2, t = 1, dx = 0.2 to 0.1", "order of E", (double)NAN,
                 (coarse.at[0] - fine.at[0]) / log10(2.0), 1.9, 2.1);
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "more time steps in the search for the best one", OPTION_FLAG, &full, 0, 0},
    };
    static report r;
    cloud c = {0};
    options_parse(argc, argv, "Table 1 of the paper on the elliptic operator: published against measured.",
                  specs, 3);
    report_open(&r, "elliptic_slit", out);
    figure_folder(figures, "elliptic_slit");
    stencil(&r, &c);
    table(&r, &c, figures);
    misprints(&r, &c);
    best_step(&r, &c, full);
    finer(&r, &c);
    cloud_close(&c);
    return report_close(&r) ? 1 : 0;
}
