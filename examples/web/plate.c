/* SPDX-License-Identifier: MIT
 *
 * plate.c - heat spreads through a square plate from its left edge, as in ../heat_plate.c, by any of the
 * elliptic operators, which is made once, as rows of weights. A pointer heats.
 */
#ifndef SPH_FN
#define SPH_FN \
    static __attribute__((noinline, unused)) /* for any kernel: small code, which need not be fast */
#endif
#include "lab.h"

enum { DIM = 2, SIDE = 61, MOST = SIDE * SIDE, PAIRS = MOST * 120 };
enum { OPERATOR, KERNEL, H_OVER_DX, ACROSS, JITTER, CONTROLS };
enum { BROOKSHAW, CORRECTED, SCHWAIGER, MSPH, BASIC };
enum { TEMPERATURE, RATE, FIELDS };
enum { MEAN, WARMEST, COLDEST, WRONG_SIGNS, STEP, MEASURES };

static lab_control controls[CONTROLS] = {
    {"operator", "Operator", "Brookshaw|Brookshaw, corrected|Schwaiger|M-SPH|Basic, Degiuli & Ban", 0, 4, 1,
     MSPH, 0},
    {"kernel", "Kernel", LAB_KERNEL_NAMES, 0, SPH_KERNEL_COUNT - 1, 1, SPH_WENDLAND_C2, 0},
    {"h", "Smoothing length h / spacing", NULL, 0.9, 2, 0.05, 1.3, 0},
    {"across", "Particles along an edge", NULL, 11, SIDE, 2, 41, 0},
    {"jitter", "Disorder, in spacings", NULL, 0, 0.4, 0.02, 0.1, 0}};
static double x[MOST], y[MOST], temperature[MOST], rate[MOST], row[PAIRS], diagonal[MOST], dx, h, V, dt;
static int n, across, wrong;
static unsigned char monotone[MOST];
static sph_cloud cloud;

static int on_edge(int i)
{
    return i % across == 0 || i % across == across - 1 || i / across == 0 || i / across == across - 1;
}
static int reset(void)
{
    const double conductivity = 1;
    const sph_kernel k = (sph_kernel)controls[KERNEL].value;
    const sph_scalars m = sph_scalars_same(&conductivity);
    const sph_elliptic_options options = {0};
    sph_rows_out rows = {0};
    sph_points points;
    sph_list list = {NULL, NULL};
    double radius;
    sph_index answer;
    int i;
    across = (int)controls[ACROSS].value;
    n = across * across;
    dx = 1.0 / (across - 1);
    h = controls[H_OVER_DX].value * dx;
    V = dx * dx;
    lab_seed(3);
    for (i = 0; i < n; i++) {
        const double px = 2 * controls[JITTER].value * lab_random(),
                     py = 2 * controls[JITTER].value * lab_random();
        x[i] = (i % across + (on_edge(i) ? 0 : px)) * dx;
        y[i] = (i / across + (on_edge(i) ? 0 : py)) * dx;
        temperature[i] = i % across == 0;
        rate[i] = 0;
    }
    points = sph_points_separate(n, x, y, NULL);
    radius = sph_kernel_support(k, h);
    LAB_TRY(lab_neighbours(DIM, points, sph_scalars_same(&radius), SPH_GATHER, &list));
    if (list.start[n] > PAIRS) return SPH_ERROR_CAPACITY;
    cloud = sph_cloud_checked(DIM, sph_cloud_of(points, list, sph_scalars_same(&h), sph_scalars_same(&V)));
    rows.row = row;
    rows.diagonal = diagonal;
    switch ((int)controls[OPERATOR].value) {
    case BROOKSHAW:
        answer = sph_elliptic_rows_brookshaw(k, DIM, cloud, m, options, rows);
        break;
    case CORRECTED:
        answer = sph_elliptic_rows_brookshaw_corrected(k, DIM, cloud, m, options, rows);
        break;
    case SCHWAIGER:
        answer = sph_elliptic_rows_schwaiger(k, DIM, cloud, m, options, rows);
        break;
    case MSPH:
        answer = sph_elliptic_rows_msph(k, DIM, cloud, m, options, rows);
        break;
    default:
        answer = sph_elliptic_rows_basic_degiuli_ban(k, DIM, cloud, m, options, rows);
        break;
    }
    LAB_TRY(answer);
    LAB_TRY(sph_rows_monotone(cloud, row, sph_scalars_array(diagonal), monotone));
    for (i = 0, wrong = 0; i < n; i++) wrong += !on_edge(i) && !monotone[i];
    LAB_TRY(sph_rows_time_step(cloud, row, &dt));
    /* half of the longest stable step: where all signs are right, nothing gets hotter than all around it */
    dt *= 0.5;
    lab_plate.n = lab_plate.n_moving = n;
    lab_plate.time = 0;
    lab_plate.size = dx;
    return 0;
}
static int step(void) /* explicit Euler; the edge keeps its temperature */
{
    int i;
    LAB_TRY(sph_rows_apply(cloud, row, sph_scalars_none(), sph_scalars_array(temperature),
                           sph_scalar_out_array(rate, NULL)));
    for (i = 0; i < n; i++) {
        if (on_edge(i)) rate[i] = 0;
        temperature[i] += dt * rate[i];
    }
    lab_plate.time += dt;
    return 0;
}
static lab_field fields[FIELDS] = {{"temperature", temperature, 0, 1}, {"its rate", rate, 0, 0}};
static lab_measure measures[MEASURES] = {
    {"mean temperature", 0}, {"warmest", 0}, {"coldest", 0}, {"rows with a wrong sign", 0}, {"time step", 0}};
static int look(void)
{
    int i;
    measures[MEAN].value = 0;
    measures[WARMEST].value = measures[COLDEST].value = temperature[0];
    for (i = 0; i < n; i++) {
        measures[MEAN].value += temperature[i] / n;
        measures[WARMEST].value = fmax(measures[WARMEST].value, temperature[i]);
        measures[COLDEST].value = fmin(measures[COLDEST].value, temperature[i]);
    }
    measures[WRONG_SIGNS].value = wrong;
    measures[STEP].value = dt;
    return 0;
}
static int changed(int control)
{
    if (control == KERNEL)
        controls[H_OVER_DX].value = fmin(2, sph_kernel_h_over_dx((sph_kernel)controls[KERNEL].value));
    return reset();
}
static int point(int phase, double px, double py) /* as hot as the left edge */
{
    int i;
    if (phase == LAB_UP) return 0;
    for (i = 0; i < n; i++)
        if (!on_edge(i) && (x[i] - px) * (x[i] - px) + (y[i] - py) * (y[i] - py) < 0.05 * 0.05)
            temperature[i] = 1;
    return 0;
}
lab_scene lab_plate = {
    .name = "plate",
    .title = "Heat in a plate",
    .about = "div(grad T) on particles in disorder, by rows of weights that are made once. The left edge "
             "has T = 1, the others T = 0. Where a row has a wrong sign, places can get hotter than all "
             "that is around them.",
    .hint = "Press and move to heat.",
    .reset = reset,
    .step = step,
    .look = look,
    .changed = changed,
    .point = point,
    .controls = controls,
    .fields = fields,
    .measures = measures,
    .n_controls = CONTROLS,
    .n_fields = FIELDS,
    .n_measures = MEASURES,
    .chosen = -1,
    .view = {-0.06, -0.04, 1.6, 1.08},
    .x = x,
    .y = y,
};
