/* SPDX-License-Identifier: MIT
 *
 * cloud.c - what gradients and Laplacians make of a cloud whose particles can be dragged: the error of each
 * particle, and the weights of the chosen one. A weight is what the operator answers for a field that is 1 at
 * one particle and 0 at all others.
 */
#ifndef SPH_FN
#define SPH_FN \
    static __attribute__((noinline, unused)) /* for any kernel: small code, which need not be fast */
#endif
#include "lab.h"

enum { DIM = 2, SIDE = 25, MOST = SIDE * SIDE, ROWS = 160 };
enum { OPERATOR, FIELD, KERNEL, H_OVER_DX, ACROSS, JITTER, VOLUMES, CONTROLS };
enum {
    DIFFERENCE,
    SYMMETRIC,
    CSPM,
    IAD,
    RK,
    GRADIENTS,
    /* Laplacians: */ BROOKSHAW = GRADIENTS,
    MSPH,
    SCHWAIGER,
    LAPLACIAN_CSPM,
    LAPLACIAN_ICSPM,
    FATEHI_MANZARI,
    WLS
};
enum { LOG_ERROR, ERROR, RESULT, EXACT, VALUE, FIELDS };
enum { RMS, INNER, OWN, NOT_OK, MEASURES };
enum { NUMBER, DISTANCE, WEIGHT_X, WEIGHT_Y, COLUMNS };
static const double pi = 3.14159265358979324;

static lab_control controls[CONTROLS] = {
    {"operator", "Operator",
     "gradient, difference|gradient, symmetric|gradient, CSPM|gradient, IAD|gradient, reproducing kernel|"
     "Laplacian, Brookshaw|Laplacian, M-SPH|Laplacian, Schwaiger|Laplacian, CSPM|Laplacian, ICSPM|Laplacian, "
     "Fatehi & Manzari|Laplacian, WLS",
     0, WLS, 1, CSPM, 0},
    {"field", "Applied to", "1|x|x^2 + y^2|x^3|sin(pi x) sin(pi y)", 0, 4, 1, 4, 0},
    {"kernel", "Kernel", LAB_KERNEL_NAMES, 0, SPH_KERNEL_COUNT - 1, 1, SPH_WENDLAND_C2, 0},
    {"h", "Smoothing length h / spacing", NULL, 0.9, 2, 0.05, 1.3, 0},
    {"across", "Particles in a row", NULL, 7, SIDE, 2, 17, 0},
    {"jitter", "Disorder, in spacings", NULL, 0, 0.45, 0.05, 0.1, 0},
    {"volumes", "Volumes", "of a lattice|1 / sum of W", 0, 1, 1, 0, 0}};
static double x[MOST], y[MOST], f[MOST], exact_x[MOST], exact_y[MOST], result_x[MOST], result_y[MOST],
    error[MOST], log_error[MOST], result[MOST], exact[MOST], volume[MOST], dx, h;
static double number[ROWS], distance[ROWS], weight_x[ROWS], weight_y[ROWS];
static unsigned char status[MOST];
static int n, chosen, held, not_ok;
static sph_cloud cloud;

static int is_gradient(void) { return controls[OPERATOR].value < GRADIENTS; }
static void evaluate(int i) /* the field, its gradient, or its Laplacian in exact_x */
{
    const double px = x[i], py = y[i], sx = sin(pi * px), cx = cos(pi * px), sy = sin(pi * py),
                 cy = cos(pi * py);
    double value = 1, gx = 0, gy = 0, laplacian = 0;
    switch ((int)controls[FIELD].value) {
    case 1:
        value = px, gx = 1;
        break;
    case 2:
        value = px * px + py * py, gx = 2 * px, gy = 2 * py, laplacian = 4;
        break;
    case 3:
        value = px * px * px, gx = 3 * px * px, laplacian = 6 * px;
        break;
    case 4:
        value = sx * sy, gx = pi * cx * sy, gy = pi * sx * cy, laplacian = -2 * pi * pi * sx * sy;
        break;
    default:
        break;
    }
    f[i] = value;
    exact_x[i] = is_gradient() ? gx : laplacian;
    exact_y[i] = is_gradient() ? gy : 0;
}
/* The operator on `values`, for the targets of `targets`. 0 where it has no answer. */
static sph_index apply(sph_cloud targets, const double *values)
{
    static double scale[MOST], slope_x[MOST], slope_y[MOST], scale_x[MOST], scale_y[MOST], slopes[4 * MOST];
    const sph_kernel k = (sph_kernel)controls[KERNEL].value;
    const double one = 1;
    const sph_scalars u = sph_scalars_array(values), same = sph_scalars_same(&one);
    const sph_medium medium = {sph_scalars_array(volume), same, same}; /* rho = 1 */
    const sph_vector_out vector = sph_vector_out_separate(result_x, result_y, NULL);
    const sph_scalar_out scalar = sph_scalar_out_array(result_x, status);
    const sph_derivatives_options usual = {0};
    const sph_elliptic_options options = {0};
    sph_derivatives_out gradient = {0}, laplacian = {0};
    sph_index i;
    gradient.gx = result_x;
    gradient.gy = result_y;
    laplacian.laplacian = result_x;
    gradient.status = laplacian.status = status;
    for (i = targets.first; i < targets.last; i++) result_y[i] = 0, status[i] = SPH_OK;
    switch ((int)controls[OPERATOR].value) {
    case DIFFERENCE:
        return sph_gradient_difference(k, DIM, targets, u, vector);
    case SYMMETRIC:
        return sph_gradient_symmetric(k, DIM, targets, medium, u, vector);
    case CSPM:
        return sph_gradient_cspm(k, DIM, targets, u, gradient);
    case IAD:
        return sph_gradient_iad(k, DIM, targets, u, gradient);
    case RK: {
        sph_rk_out out = {0};
        sph_rk rk;
        sph_index answer;
        out.scale = scale;
        out.slope = sph_vector_out_separate(slope_x, slope_y, NULL);
        out.scale_gradient = sph_vector_out_separate(scale_x, scale_y, NULL);
        out.slope_gradient = sph_matrix_out_packed(DIM, slopes);
        out.status = status;
        answer = sph_rk_correction(k, DIM, targets, out);
        if (answer < 0) return answer;
        rk.scale = sph_scalars_array(scale);
        rk.slope = sph_vectors_separate(slope_x, slope_y, NULL);
        rk.scale_gradient = sph_vectors_separate(scale_x, scale_y, NULL);
        rk.slope_gradient = sph_matrices_packed(DIM, slopes);
        return sph_gradient_rk(k, DIM, targets, rk, u, vector);
    }
    case BROOKSHAW:
        return sph_laplacian_brookshaw(k, DIM, targets, u, scalar);
    case MSPH:
        return sph_elliptic_msph(k, DIM, targets, same, options, u, scalar);
    case SCHWAIGER:
        return sph_elliptic_schwaiger(k, DIM, targets, same, options, u, scalar);
    case LAPLACIAN_CSPM:
        return sph_derivatives_cspm(k, DIM, targets, u, usual, laplacian);
    case LAPLACIAN_ICSPM:
        return sph_derivatives_icspm(k, DIM, targets, u, usual, laplacian);
    case FATEHI_MANZARI:
        return sph_derivatives_fatehi_manzari(k, DIM, targets, u, usual, laplacian);
    default:
        return sph_derivatives_wls(k, DIM, targets, u, usual, laplacian);
    }
}
static int row_of_chosen(void)
{
    static double unit[MOST];
    const sph_cloud alone = sph_cloud_range(cloud, chosen, chosen + 1);
    const sph_index first = cloud.list.start[chosen], last = cloud.list.start[chosen + 1];
    const double kept_x = result_x[chosen], kept_y = result_y[chosen];
    const int was = status[chosen];
    sph_index p;
    lab_cloud.n_rows = 0;
    for (p = first - 1; p < last && lab_cloud.n_rows < ROWS; p++) { /* itself, then its neighbours */
        const int j = p < first ? chosen : (int)cloud.list.index[p], r = lab_cloud.n_rows++;
        const double sx = x[j] - x[chosen], sy = y[j] - y[chosen];
        unit[j] = 1;
        LAB_TRY(apply(alone, unit));
        unit[j] = 0;
        number[r] = j;
        distance[r] = sqrt(sx * sx + sy * sy) / dx;
        weight_x[r] = result_x[chosen];
        weight_y[r] = result_y[chosen];
    }
    result_x[chosen] = kept_x;
    result_y[chosen] = kept_y;
    status[chosen] = (unsigned char)was;
    return 0;
}
static int compute(void)
{
    const sph_kernel k = (sph_kernel)controls[KERNEL].value;
    const sph_points points = sph_points_separate(n, x, y, NULL);
    const double one = 1, radius = sph_kernel_support(k, h);
    sph_list list = {NULL, NULL};
    int i;
    LAB_TRY(lab_neighbours(DIM, points, sph_scalars_same(&radius), SPH_GATHER, &list));
    for (i = 0; i < n; i++) volume[i] = dx * dx;
    cloud = sph_cloud_of(points, list, sph_scalars_same(&h), sph_scalars_array(volume));
    if (controls[VOLUMES].value > 0) {
        LAB_TRY(
            sph_density_summation(k, DIM, cloud, sph_scalars_same(&one), sph_scalar_out_array(volume, NULL)));
        for (i = 0; i < n; i++) volume[i] = 1 / volume[i];
    }
    for (i = 0; i < n; i++) evaluate(i);
    LAB_TRY(not_ok = (int)apply(cloud, f));
    return row_of_chosen();
}
static int reset(void)
{
    const int across = (int)controls[ACROSS].value;
    int i;
    n = across * across;
    dx = 1.0 / across;
    h = controls[H_OVER_DX].value * dx;
    lab_seed(11);
    for (i = 0; i < n; i++) {
        const double jx = lab_random(), jy = lab_random();
        x[i] = (i % across + 0.5 + 2 * controls[JITTER].value * jx) * dx;
        y[i] = (i / across + 0.5 + 2 * controls[JITTER].value * jy) * dx;
    }
    chosen = n / 2;
    held = 0;
    lab_cloud.n = lab_cloud.n_moving = n;
    lab_cloud.size = 0.8 * dx;
    return compute();
}
static lab_field fields[FIELDS] = {{"log10 of the error", log_error, -4, 0},
                                   {"error", error, 0, 1},
                                   {"result, of a gradient its length", result, 0, 0},
                                   {"exact", exact, 0, 0},
                                   {"the field itself", f, 0, 0}};
static lab_measure measures[MEASURES] = {{"rms error", 0},
                                         {"rms error two supports inside", 0},
                                         {"error of the chosen particle", 0},
                                         {"particles without a good answer", 0}};
static lab_column columns[COLUMNS] = {
    {"particle", number}, {"distance / spacing", distance}, {"weight", weight_x}, {"weight y", weight_y}};
static int look(void)
{
    const double margin = fmin(0.4, 2 * sph_kernel_support((sph_kernel)controls[KERNEL].value, h));
    double all = 0, inner = 0, count = 0;
    int i;
    fields[ERROR].most = 1e-15;
    for (i = 0; i < n; i++) {
        const double ex = result_x[i] - exact_x[i], ey = result_y[i] - exact_y[i];
        error[i] = sqrt(ex * ex + ey * ey);
        result[i] = is_gradient() ? sqrt(result_x[i] * result_x[i] + result_y[i] * result_y[i]) : result_x[i];
        exact[i] = is_gradient() ? sqrt(exact_x[i] * exact_x[i] + exact_y[i] * exact_y[i]) : exact_x[i];
        fields[ERROR].most = fmax(fields[ERROR].most, error[i]);
        log_error[i] = log(fmax(error[i], 1e-15)) / log(10.0);
        all += error[i] * error[i] / n;
        if (x[i] > margin && x[i] < 1 - margin && y[i] > margin && y[i] < 1 - margin)
            inner += error[i] * error[i], count++;
    }
    fields[LOG_ERROR].most = log(fields[ERROR].most) / log(10.0);
    fields[LOG_ERROR].least = fields[LOG_ERROR].most - 4;
    measures[RMS].value = sqrt(all);
    measures[INNER].value = count > 0 ? sqrt(inner / count) : 0;
    measures[OWN].value = error[chosen];
    measures[NOT_OK].value = not_ok;
    lab_cloud.chosen = chosen;
    lab_cloud.n_columns = is_gradient() ? COLUMNS : COLUMNS - 1;
    columns[WEIGHT_X].name = is_gradient() ? "weight x" : "weight";
    return 0;
}
static int changed(int control)
{
    if (control == KERNEL)
        controls[H_OVER_DX].value = fmin(2, sph_kernel_h_over_dx((sph_kernel)controls[KERNEL].value));
    if (control == ACROSS || control == JITTER) return reset();
    h = controls[H_OVER_DX].value * dx;
    return compute();
}
static int point(int phase, double px, double py) /* chooses the nearest particle, and takes it along */
{
    double least = 1e30;
    int i;
    if (phase == LAB_DOWN) {
        for (i = 0; i < n; i++) {
            const double r2 = (x[i] - px) * (x[i] - px) + (y[i] - py) * (y[i] - py);
            if (r2 < least) least = r2, chosen = i;
        }
        held = 1;
    } else if (phase == LAB_MOVE && held) {
        x[chosen] = fmax(-0.1, fmin(1.1, px));
        y[chosen] = fmax(-0.1, fmin(1.1, py));
    } else held = 0;
    return compute();
}
lab_scene lab_cloud = {
    .name = "cloud",
    .title = "Operators",
    .about = "What an operator makes of a cloud of particles: drag one and see which errors follow. The "
             "unit square has no neighbours beyond its edge, so that the outermost particles are at a "
             "free boundary.",
    .hint = "Press on a particle to choose it, and drag it.",
    .reset = reset,
    .look = look,
    .changed = changed,
    .point = point,
    .controls = controls,
    .fields = fields,
    .measures = measures,
    .columns = columns,
    .n_controls = CONTROLS,
    .n_fields = FIELDS,
    .n_measures = MEASURES,
    .n_columns = COLUMNS,
    .view = {-0.12, -0.12, 1.72, 1.24},
    .x = x,
    .y = y,
};
