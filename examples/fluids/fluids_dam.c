/* SPDX-License-Identifier: MIT
 *
 * fluids_dam.c - a dam breaks: the front beside experiments, and the noise of the pressure, by one method after
 * the other.
 *
 *     cc -O2 -o fluids_dam examples/fluids/fluids_dam.c -lm
 *     fluids_dam -out DIR -figures DIR [-full]       (-h for help)
 *
 * A column of A x 2 A in a tank of 4 A x 3 A, 20 x 40 particles, walls of Adami's ghosts, h = 1.6 dx,
 * c0 = 20 sqrt(gA), alpha = 0.02, from rest with the pressure rho g (2 A - y). Lengths are in A, times in
 * sqrt(A / g). Figures: noise of the pressure at t = 1.2, when the front is near the middle of the tank, and at
 * 2.4, when it has hit the wall, in rho g A; the front at 1.2; share of the particles that are nearer than
 * dx / 2 to another; energy at 1.2, in that of the start, where only methods with energy of their own gain any.
 * Martin & Moyce 1952 and Koshizuka & Oka 1996 stand beside the front (../common/column.h).
 *
 * The gauge: water of 2 H x H in a tank of 5.366 H, 32 particles in H (-full: 40), to t = 4.8 sqrt(H / g) (-full: 7.3),
 * and the pressure on the wall 0.117 to 0.267 H above the floor, beside that of B. Buchner, Green water on ship-type
 * offshore structures, thesis, Delft 2002. His gauge had its centre where this one has its top: all who compute this
 * flow shift it (Greco 2001; Adami, Hu & Adams 2012), because the experiment is not sure of it either.
 *
 * L. Lobovsky, E. Botia-Vera, F. Castellana, J. Mas-Soler & A. Souto-Iglesias 2014, J. Fluids Struct. 48, 407
 * (arXiv:1308.0115) measured the same tank a hundred times, with H = 0.3 m: the front, and four sensors of 4.2 mm, 3,
 * 15, 30 and 80 mm above the floor. Beside them stand sensors of ours, points at the same heights: 0.01, 0.05, 0.1 and
 * 0.267 H. The largest pressure of ours is that of its mean over 0.05 sqrt(H / g), which is what sound needs to cross H.
 */
#include "fluids.h"
#include "../common/column.h"

enum { EARLY, LATE, FRONT, CLUSTERED, ENERGY };

static FILE *fronts;        /* lines of the figure */
static report *table;
static front_record front; /* of the run that has ended last, in metres and seconds */

static double farthest(const flow *f)
{
    double x = 0;
    int i;
    for (i = 0; i < f->n_fluid; i++) x = fmax(x, f->x[i] + 0.5 * f->dref);
    return x;
}
static void watch(flow *f)
{
    const double t = f->t * sqrt(column_a / column_gravity);
    if (front_due(&front, t)) front_add(&front, t, farthest(f) * column_a);
}
static double energy(const liquid *l)
{
    return flow_kinetic_energy(&l->f) + liquid_height(l) * liquid_mass(l);
}
static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    enum { SIDE = 20 };
    const double dx = 1.0 / SIDE;
    const flow_domain all = {0, 0, 0, 0};
    liquid l;
    double before;
    int i, j;
    liquid_open(&l, m, dx, 1.6 * dx, 20, 0.02);
    l.f.gravity_y = -1;
    l.surface = 1;
    for (j = 0; j < 2 * SIDE; j++)
        for (i = 0; i < SIDE; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 2 - (j + 0.5) * dx);
    liquid_add_tank(&l, 4 * SIDE, 3 * SIDE);
    liquid_start(&l, 0, o);
    liquid_shake(&l, seed);
    front.count = 0;
    front.every = 2.4 * sqrt(column_a / column_gravity) / (FRONT_SAMPLES - 1);
    l.f.after = watch;
    watch(&l.f);
    before = energy(&l);
    flow_require(&l.f, flow_run(&l.f, 1.2));
    figure[EARLY] = liquid_noise(&l);
    figure[FRONT] = farthest(&l.f);
    figure[ENERGY] = energy(&l) / before;
    flow_require(&l.f, flow_run(&l.f, 2.4));
    figure[LATE] = liquid_noise(&l);
    figure[CLUSTERED] = flow_measure(&l.f, FLOW_ALL, 0, all, NULL).below_50;
    if (seed == 0) {
        column_lines(fronts, m->file, &front);
        column_rows(table, m->name, &front, m->diffusion == LIQUID_ANTUONO && !m->shift);
    }
    liquid_end(&l, "dam", seed, o);
}

/* ---------------------------------------------------------------- the gauge */

/* t sqrt(g / H), p / rho g H of gauge P1; as digitised for TrixiParticles (validation/dam_break_2d); every third
   point of the plateau and of the second peak, all of the rise */
enum { BUCHNER = 39 };
static const double buchner_t[BUCHNER] = {2.025, 2.272, 2.426, 2.473, 2.491, 2.553, 2.616, 2.623, 2.650, 2.672,
                                          2.689, 2.774, 2.835, 2.903, 2.961, 3.022, 3.132, 3.231, 3.368, 3.679,
                                          4.060, 4.355, 4.571, 4.817, 5.038, 5.304, 5.445, 5.586, 5.692, 5.781,
                                          5.806, 5.833, 5.869, 5.904, 5.968, 6.051, 6.222, 6.423, 6.654};
static const double buchner_p[BUCHNER] = {-.018, .010, -.015, .077, .154, .265, .371, .463, .562, .605,
                                          .662,  .687, .672,  .661, .646, .643, .579, .546, .541, .541,
                                          .556,  .555, .543,  .517, .514, .526, .549, .588, .634, .675,
                                          .716,  .877, .839,  .765, .648, .579, .556, .497, .502};
/* Lobovsky et al. 2014. Front: x / H from the gate, fig. 12 (H = 0.3 m), the authors' numbers as kept with AQUAgpusph
   (examples/lobovsky_etal_jfs_2013/doc), between its samples. The wall is at 3.367. Sensors: height / H; median of the
   largest pressure in a hundred runs, table 2, in mbar, as printed for warpSPH (scripts/
   probe_acsphDambreakLobovsky.py), where 2.5 and 97.5 % are 75.06, 130.98; 53.26, 63.31; 39.79, 49.62; 24.18, 36.32.
   The mean of the third from t = 2.6 to 3.1: the authors' one run of fig. 18, as kept with TNL-SPH
   (examples/resources/damBreak2D), whose largest pressure is 1.54 rho g H. */
enum { FRONTS = 4, SENSORS = 4, THIRD = 2 };
static const double lobovsky_t[FRONTS] = {1, 1.5, 2, 2.4}, lobovsky_x[FRONTS] = {.906, 1.594, 2.365, 3.040},
                    lobovsky_arrival = 2.573, lobovsky_third = 1.36, lobovsky_mbar = 997 * 9.81 * 0.3 / 100;
static const double sensor_height[SENSORS] = {0.01, 0.05, 0.1, 0.08 / 0.3};
static const double lobovsky_peak[SENSORS] = {91.44, 57.49, 43.76, 30.15};

enum { GAUGE_SAMPLES = 2000, GAUGE_POINTS = 4, GAUGES = 1 + SENSORS };
/* p: mean of Buchner's gauge, and the sensors of Lobovsky; x: the front, from the gate */
typedef struct gauge_record {
    int count;
    double wall, t[GAUGE_SAMPLES], p[GAUGES][GAUGE_SAMPLES], x[GAUGE_SAMPLES];
} gauge_record;
static gauge_record gauge;

/* at points of the wall, of the fit to the water in front of it; where there is none, 0 */
static void read_gauge(flow *f)
{
    const double every = 0.01, reach = sph_kernel_support_ratio(f->kernel) * f->h;
    enum { POINTS = GAUGE_POINTS + SENSORS };
    double x[POINTS], y[POINTS], p[POINTS], mean = 0;
    search_grid grid = {0};
    search_lists lists = {0};
    sph_points water = flow_points(f), points = sph_points_separate(POINTS, x, y, NULL);
    const sph_interpolation_options options = {.conditioning_min = 0.05};
    const sph_interpolation_out out = {.value = p};
    sph_sources sources;
    int k;
    if (gauge.count == GAUGE_SAMPLES || f->t < gauge.count * every) return;
    for (k = 0; k < POINTS; k++) {
        x[k] = gauge.wall;
        y[k] = k < GAUGE_POINTS ? 0.267 - 0.15 * (k + 0.5) / GAUGE_POINTS : sensor_height[k - GAUGE_POINTS];
    }
    water.n = f->n_fluid;
    liquid_volumes(f);
    sources.points = water;
    sources.volume = sph_scalars_array(f->volume);
    search_grid_build(&grid, 2, water, reach);
    search_lists_find(&lists, 2, &grid, sph_query_of(points, SPH_GATHER, sph_scalars_same(&reach), SPH_LIST_FOREIGN));
    expect(sph_interpolate_mls(SPH_WENDLAND_C2, 2,
                               sph_cloud_of(points, search_list(&lists), sph_scalars_same(&f->h), sph_scalars_none()), sources,
                               sph_scalars_array(f->p), options, out));
    for (k = 0; k < GAUGE_POINTS; k++) mean += p[k] / GAUGE_POINTS;
    gauge.t[gauge.count] = f->t;
    gauge.p[0][gauge.count] = mean;
    for (k = 0; k < SENSORS; k++) gauge.p[1 + k][gauge.count] = p[GAUGE_POINTS + k];
    gauge.x[gauge.count++] = farthest(f) - 2;
    search_lists_close(&lists);
    search_grid_close(&grid);
}
static double gauge_mean(const double *t, const double *p, int count, double from, double to)
{
    double sum = 0, time = 0;
    int k;
    for (k = 1; k < count; k++)
        if (t[k] > from && t[k - 1] < to) {
            sum += 0.5 * (p[k] + p[k - 1]) * (t[k] - t[k - 1]);
            time += t[k] - t[k - 1];
        }
    return sum / time;
}
static double gauge_first(const double *t, const double *value, int count, double limit)
{
    int k;
    for (k = 0; k < count; k++)
        if (value[k] > limit) return t[k];
    return (double)NAN;
}
/* the largest mean over 0.05 */
static double gauge_peak(const double *t, const double *p, int count)
{
    double most = 0;
    int k;
    for (k = 0; k < count; k++)
        if (t[k] + 0.05 < t[count - 1]) most = fmax(most, gauge_mean(t, p, count, t[k], t[k] + 0.05));
    return most;
}
static double gauge_front_at(double t)
{
    int k = 1;
    while (k < gauge.count - 1 && gauge.t[k] < t) k++;
    return gauge.x[k - 1] + (gauge.x[k] - gauge.x[k - 1]) * (t - gauge.t[k - 1]) / (gauge.t[k] - gauge.t[k - 1]);
}
/* What the gauges show. */
enum { ARRIVAL, IMPACT, PLATEAU, TOUCH, SPEED, THRUST, PEAK, GAUGE_FIGURES = PEAK + SENSORS };
static void run_gauge(const liquid_method *m, int seed, const fluids_options *o, FILE *to, double *figure)
{
    const int side = o->full ? 40 : 32, columns = (int)(5.366 * side + 0.5);
    const double dx = 1.0 / side;
    double front_x[FRONTS];
    liquid l;
    int i, j, k;
    liquid_open(&l, m, dx, 1.6 * dx, 20, 0.02);
    l.f.gravity_y = -1;
    l.surface = 1;
    l.speed = 2;
    for (j = 0; j < side; j++)
        for (i = 0; i < 2 * side; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 1 - (j + 0.5) * dx);
    liquid_add_tank(&l, columns, 3 * side);
    liquid_start(&l, 0, o);
    liquid_shake(&l, seed);
    memset(&gauge, 0, sizeof gauge);
    gauge.wall = columns * dx;
    l.f.after = read_gauge;
    flow_require(&l.f, flow_run(&l.f, o->full ? 7.3 : 4.8));
    for (i = 0; i < gauge.count && seed == 0; i++) {
        fprintf(to, "%s,%.6g", m->file, gauge.t[i]);
        for (k = 0; k < GAUGES; k++) fprintf(to, ",%.6g", gauge.p[k][i]);
        fprintf(to, ",%.6g\n", gauge.x[i]);
    }
    figure[ARRIVAL] = gauge_first(gauge.t, gauge.p[0], gauge.count, 0.2);
    figure[IMPACT] = gauge_mean(gauge.t, gauge.p[0], gauge.count, 2.6, 3.1);
    figure[PLATEAU] = gauge_mean(gauge.t, gauge.p[0], gauge.count, 3.2, 4.8);
    figure[TOUCH] = gauge_first(gauge.t, gauge.x, gauge.count, gauge.wall - 2 - 0.5 * dx);
    for (k = 0; k < FRONTS; k++) front_x[k] = gauge_front_at(lobovsky_t[k]);
    figure[SPEED] = statistics_slope(lobovsky_t, front_x, FRONTS);
    figure[THRUST] = gauge_mean(gauge.t, gauge.p[1 + THIRD], gauge.count, 2.6, 3.1);
    for (k = 0; k < SENSORS; k++) figure[PEAK + k] = gauge_peak(gauge.t, gauge.p[1 + k], gauge.count);
    liquid_close(&l);
}
/* Beside the experiments. seeds: how many, for the range over them; 0: none. What another seed changes by much is not
   judged by one run, but by whether the experiment lies in the range. */
static void compare_gauge(report *r, const liquid_method *m, const fluids_options *o, int seeds, FILE *to)
{
    static const double tolerance[GAUGE_FIGURES] = {[ARRIVAL] = 0.15, [PLATEAU] = 0.11, [TOUCH] = 0.15, [SPEED] = 0.08};
    static const char *const item = "gauge", *const friction = "its dissipation at the floor holds back the front",
                            *const tongue = "the tongue of water is three particles thick",
                            *const sound = "a blow of c0 = 20 sqrt(gH), which real water does not feel";
    static const char *const quantity[GAUGE_FIGURES] = {"arrival: p > 0.2 rho g H (Buchner)",
                                                        "mean, t = 2.6 to 3.1 / rho g H (Buchner)",
                                                        "mean, t = 3.2 to 4.8 / rho g H (Buchner)",
                                                        "front at the wall (Lobovsky et al.)",
                                                        "dx/dt of the front, t = 1 to 2.4 (Lobovsky et al.)",
                                                        "sensor 3, mean, t = 2.6 to 3.1 (Lobovsky et al.)",
                                                        "sensor 1, largest (Lobovsky et al.)",
                                                        "sensor 2, largest (Lobovsky et al.)",
                                                        "sensor 3, largest (Lobovsky et al.)",
                                                        "sensor 4, largest (Lobovsky et al.)"};
    double figure[GAUGE_FIGURES], seen[LIQUID_SEEDS][GAUGE_FIGURES], known[GAUGE_FIGURES];
    int k, s;
    run_gauge(m, 0, o, to, figure);
    for (s = 0; s < seeds; s++) run_gauge(m, s + 1, o, to, seen[s]);
    known[ARRIVAL] = gauge_first(buchner_t, buchner_p, BUCHNER, 0.2);
    known[IMPACT] = gauge_mean(buchner_t, buchner_p, BUCHNER, 2.6, 3.1);
    known[PLATEAU] = gauge_mean(buchner_t, buchner_p, BUCHNER, 3.2, 4.8);
    known[TOUCH] = lobovsky_arrival;
    known[SPEED] = statistics_slope(lobovsky_t, lobovsky_x, FRONTS);
    known[THRUST] = lobovsky_third;
    for (k = 0; k < SENSORS; k++) known[PEAK + k] = lobovsky_peak[k] / lobovsky_mbar;
    for (k = 0; k < GAUGE_FIGURES; k++) {
        double low = figure[k], high = figure[k];
        for (s = 0; s < seeds; s++) {
            low = fmin(low, seen[s][k]);
            high = fmax(high, seen[s][k]);
        }
        if (k == PEAK + 3 && !o->full) { /* the second wave comes later */
            report_info(r, item, m->name, "sensor 4, largest until t = 4.8", figure[k]);
            continue;
        }
        report_beside(r, REPORT_OTHERS);
        if (m->riemann && (k == ARRIVAL || k == PLATEAU || k == TOUCH)) /* known to be apart: it differs if it is not */
            report_number_row(r, item, m->name, quantity[k], known[k], figure[k], NULL, friction,
                              fabs(figure[k] - known[k]) > tolerance[k] ? REPORT_NOT_REPRODUCED : REPORT_DIFFERS);
        else if (tolerance[k] > 0)
            report_absolute(r, item, m->name, quantity[k], known[k], figure[k], tolerance[k]);
        else if (seeds > 0)
            report_band(r, item, m->name, quantity[k], known[k], figure[k], low, high, REPORT_NOT_REPRODUCED, k < PEAK ? tongue : sound);
        else report_number_row(r, item, m->name, quantity[k], known[k], figure[k], NULL, NULL, REPORT_INFO);
        if (seeds > 0) liquid_range(r, item, m->name, quantity[k], &seen[0][k], GAUGE_FIGURES);
    }
}

int main(int argc, char **argv)
{
    static const liquid_case dam = {
        "dam",
        5,
        {"noise at t = 1.2", "noise at t = 2.4", "front at t = 1.2", "f(<0.5) at t = 2.4", "energy at t = 1.2"},
        {1.5, 2.5, 1.02, 4, 1.02},
        run, 0};
    enum { PLAIN, MOLTENI, ANTUONO, FOURTAKAS, SUN, RIEMANN, METHODS = RIEMANN + 5 };
    static const liquid_trial trial[METHODS] = {{METHOD_PLAIN, {.497, 0, 2.174, .106}, 0},
                                                {METHOD_MOLTENI, {.0769, 0, 2.178}, 0},
                                                {METHOD_ANTUONO, {.0727, 0, 2.178, .061}, 0},
                                                {METHOD_FOURTAKAS, {.0704, 0, 2.178}, 0},
                                                {METHOD_SUN, {.0382}, 0},
                                                {METHOD_RIEMANN, {.0405}, 0},
                                                {METHOD_RIEMANN_GRAVITY, {0}, 1},
                                                {METHOD_EDAC, {0}, 1},
                                                {METHOD_SKILLEN, {0}, 1},
                                                {METHOD_SUN_2019, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x;
    static const liquid_method gauged[] = {METHOD_FOURTAKAS, METHOD_ANTUONO, METHOD_SUN, METHOD_RIEMANN_GRAVITY};
    FILE *to;
    int k;
    options_parse(argc, argv, "A dam breaks, by one method after the other.", specs, FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_dam", o.out);
    figure_folder(o.figures, "fluids_dam");
    fronts = figure_open(o.figures, "fluids_dam_front");
    fprintf(fronts, "run,T,Z\n");
    column_experiment_lines(fronts);
    table = &r;
    liquid_compare(&r, &dam, trial, METHODS, &o, &x);
    figure_close(fronts);
    if (o.method) return report_close(&r) ? 1 : 0;

    report_section(&r, "What diffusion does, and leaves alone");
    for (k = MOLTENI; k <= FOURTAKAS; k++) {
        report_range(&r, "dam", trial[k].method.name, "noise at t = 1.2, plain / this", (double)NAN,
                     x.figure[PLAIN][EARLY] / x.figure[k][EARLY], 5, 50);
        report_range(&r, "dam", trial[k].method.name, "front at t = 1.2 / plain", (double)NAN,
                     x.figure[k][FRONT] / x.figure[PLAIN][FRONT], 0.99, 1.01);
    }
    report_range(&r, "dam", "Riemann", "noise at t = 1.2", (double)NAN, x.figure[RIEMANN][EARLY], 0, 0.06);
    report_range(&r, "dam", "Antuono, Sun 2017", "f(<0.5) at t = 2.4", (double)NAN, x.figure[SUN][CLUSTERED], 0, 0.01);

    report_section(&r, "A gauge in the wall, where the front hits it");
    to = figure_open(o.figures, "fluids_dam_gauge");
    fprintf(to, "run,t,p,sensor1,sensor2,sensor3,sensor4,front\n");
    for (k = 0; k < BUCHNER; k++) fprintf(to, "buchner,%g,%g\n", buchner_t[k], buchner_p[k]);
    for (k = 0; k < (o.full ? 4 : 1); k++) compare_gauge(&r, &gauged[k], &o, k == 0 ? LIQUID_SEEDS : 0, to);
    figure_close(to);
    return report_close(&r) ? 1 : 0;
}
