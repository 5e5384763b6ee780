/* SPDX-License-Identifier: MIT
 *
 * fluids_drop.c - a drop in another liquid of the same density, with surface tension: at rest, from a square, and
 * oscillating; by the stress (CSS) and by the curvature (CSF).
 *
 *     cc -O2 -o fluids_drop examples/fluids/fluids_drop.c -lm
 *     fluids_drop -out DIR -figures DIR [-full]       (-h for help)
 *
 * Periodic box of 1 x 1, 32 x 32 particles (-full: 64 x 64, too; -side N) on a square lattice, drop of R = 1/4, sigma = 1, rho = 1,
 * c0 = 20, h = 2 dx, pressure p0 = 2 sigma / R, viscosity of Monaghan & Cleary.
 *   rest      nu = 0.05, to t = 0.6, which is five times sqrt(rho R^3 / sigma): jump of the mean pressure in sigma / R;
 *             rms speed as a capillary number mu U / sigma (parasitic currents: nothing should move); momentum that
 *             has come into being, in the sum of m |v|; length of the interface, the integral of |grad c|, in 2 pi R.
 *   square    nu = 0.05, a square of the same area (length 1.128), to t = 0.6: the same.
 *   ellipse   nu = 0.01, axes 1.15 R and R / 1.15: period of <x^2 - y^2>, and the ratio of its lowest value, half a
 *             period after the start, to the first. In units of 2 pi / w0, w0^2 = n (n^2 - 1) sigma / (2 rho R^3) with
 *             n = 2, the period of small waves without viscosity (Lamb, Hydrodynamics, for cylinders). Waves of the
 *             frequency s in two equal viscous liquids obey s^2 = -w0^2 (1 - k / sqrt(k^2 + s / nu)), if the interface
 *             is plane; with k = n / R the period is 1.083, and the ratio -0.743.
 */
#include "fluids.h"

enum { JUMP, CURRENT, MOMENTUM, LENGTH };
enum { REST, SQUARE, ELLIPSE, SHAPES };

static const double sigma = 1, radius = 0.25;
static int side = 32, shape;
static double *colour, *smooth;
enum { SAMPLES = 20000 };
static double when[SAMPLES], stretch[SAMPLES];
static int samples;

/* ---------------------------------------------------------------- surface tension, after the other forces */

static long normal_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    return sph_gradient_difference(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last),
                                   sph_scalars_array(l->method->tension ? smooth : colour),
                                   vectors_into(l->normal, 2));
}
static long smooth_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    return sph_interpolate_shepard(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), sph_scalars_array(colour),
                                   sph_scalar_out_array(smooth, NULL));
}
static long tension_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_tension t = {.rho = sph_scalars_array(f->rho), .normal = vectors_of(l->normal, 2), .sigma = sigma};
    const sph_tension_out by_curvature = {.acceleration = vectors_into(l->background, 2)};
    if (!l->method->tension)
        return sph_tension_css(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), t, by_curvature.acceleration);
    sph_tension_csf(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), t, by_curvature);
    return 0; /* a particle whose normal stands alone feels none */
}
static void forces(flow *f)
{
    liquid *const l = liquid_of(f);
    int i;
    viscous_forces(f);
    liquid_volumes(f);
    if (l->method->tension) liquid_each(f, smooth_part);
    liquid_each(f, normal_part);
    liquid_each(f, tension_part);
    for (i = 0; i < f->n; i++) {
        f->ax[i] += l->background[0][i];
        f->ay[i] += l->background[1][i];
    }
}

/* ---------------------------------------------------------------- runs */

static int inside(double x, double y)
{
    const double half = 0.5 * sqrt(MATH_PI) * radius, stretched = 1.15;
    if (shape == SQUARE) return fabs(x) < half && fabs(y) < half;
    if (shape == ELLIPSE) {
        x /= stretched;
        y *= stretched;
    }
    return x * x + y * y < radius * radius;
}
/* <x^2 - y^2> over the drop, about the middle of the box */
static double stretched_by(const flow *f)
{
    double sum = 0;
    int i;
    for (i = 0; i < f->n; i++) {
        const double x = f->x[i] - floor(f->x[i]) - 0.5, y = f->y[i] - floor(f->y[i]) - 0.5;
        sum += colour[i] * (x * x - y * y);
    }
    return sum;
}
static void watch(flow *f)
{
    if (samples == SAMPLES) return;
    when[samples] = f->t;
    stretch[samples++] = stretched_by(f);
}
/* particles more than h from the interface */
static double jump(const liquid *l)
{
    const flow *const f = &l->f;
    double sum[2] = {0, 0}, count[2] = {0, 0};
    int i;
    for (i = 0; i < f->n; i++) {
        const int in = colour[i] > 0.5;
        if (hypot(l->normal[0][i], l->normal[1][i]) > 1e-9) continue;
        sum[in] += f->p[i];
        count[in]++;
    }
    return sum[1] / count[1] - sum[0] / count[0];
}
static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    static const char *const name[SHAPES] = {"drop_rest", "drop_square", "drop_ellipse"};
    const double dx = 1.0 / side, nu = shape == ELLIPSE ? 0.01 : 0.05, p0 = 2 * sigma / radius,
                 period = 2 * MATH_PI * sqrt(2 * radius * radius * radius / (6 * sigma));
    double sum = 0, speed = 0, px = 0, py = 0, length = 0, mass = 0;
    liquid l;
    int i, j;
    liquid_open(&l, m, dx, 2 * dx, 20, 0);
    l.form = VISCOUS_MONAGHAN_CLEARY;
    l.f.box_x = l.f.box_y = 1;
    l.f.state[0].p0 = p0;
    for (j = 0; j < side; j++)
        for (i = 0; i < side; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, p0);
    liquid_start(&l, nu, o);
    liquid_shake(&l, seed);
    l.f.force = forces;
    colour = (double *)need_zeros((size_t)l.f.n, sizeof *colour);
    smooth = (double *)need_zeros((size_t)l.f.n, sizeof *smooth);
    for (i = 0; i < l.f.n; i++) {
        colour[i] = inside(l.f.x[i] - 0.5, l.f.y[i] - 0.5);
        l.f.phase[i] = (unsigned char)colour[i];
    }
    l.f.state[1] = l.f.state[0];
    samples = 0;
    l.f.after = watch;
    watch(&l.f);
    flow_require(&l.f, flow_run(&l.f, shape == ELLIPSE ? 0.7 * period : 0.6));
    for (i = 0; i < l.f.n; i++) {
        const double v2 = l.f.vx[i] * l.f.vx[i] + l.f.vy[i] * l.f.vy[i];
        sum += l.f.m[i] * v2;
        speed += l.f.m[i] * sqrt(v2);
        px += l.f.m[i] * l.f.vx[i];
        py += l.f.m[i] * l.f.vy[i];
        mass += l.f.m[i];
        length += l.f.m[i] / l.f.rho[i] * hypot(l.normal[0][i], l.normal[1][i]);
    }
    figure[JUMP] = jump(&l) * radius / sigma;
    figure[CURRENT] = nu * sqrt(sum / mass) / sigma;
    figure[MOMENTUM] = hypot(px, py) / speed;
    figure[LENGTH] = length / (2 * MATH_PI * radius);
    if (shape == ELLIPSE) { /* from the lowest value, half a period after the start, with its neighbours */
        int low = 0;
        for (i = 1; i < samples; i++)
            if (stretch[i] < stretch[low]) low = i;
        figure[JUMP] = 2 * when[low] / period;
        figure[CURRENT] = stretch[low] / stretch[0];
    }
    free(colour);
    free(smooth);
    liquid_end(&l, name[shape], seed, o);
}

int main(int argc, char **argv)
{
#define FIGURES 4, {"jump / (sigma / R)", "mu U / sigma", "momentum", "length / 2 pi R"}, {2, 2, 2, 2}, run, 0
    static const liquid_case cases[SHAPES] = {
        {"at rest", FIGURES},
        {"from a square", FIGURES},
        {"ellipse", 3, {"period / exact", "stretch after half of it", "momentum"}, {2, 2, 2}, run, 0}};
    enum { CSS, CSF, METHODS = CSF + 3 };
    static const liquid_trial trial[METHODS] = {
        {METHOD_CSS, {0}, 0}, {METHOD_CSF, {0}, 0}, {METHOD_CSS_SUN, {0}, 1}, {METHOD_CSS_ANTUONO, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    int only = 0;
    const option_spec specs[] = {
        FLUIDS_OPTIONS(o),
        {"side", "particles in a row; 0: 32, and with -full 64, too", OPTION_INT, &only, 0, 1024}};
    static report r;
    static liquid_results x[SHAPES];
    int k;
    options_parse(argc, argv, "A drop with surface tension: at rest, from a square, oscillating.", specs,
                  FLUIDS_OPTION_COUNT + 1);
    report_open(&r, "fluids_drop", o.out);
    figure_folder(o.figures, "fluids_drop");
    for (k = o.full && !only; k >= 0; k--) { /* the finer ones first: what is judged are those of 32 */
        side = only ? only : k ? 64 : 32;
        for (shape = 0; shape < SHAPES; shape++) {
            char item[48];
            liquid_case now = cases[shape];
            snprintf(item, sizeof item, "%s, %d x %d", now.item, side, side);
            now.item = item;
            report_section(&r, item);
            liquid_compare(&r, &now, trial, METHODS, &o, &x[shape]);
        }
    }
    if (o.method || only) return report_close(&r) ? 1 : 0;
    report_section(&r, "What is known of drops");
    for (k = CSS; k <= CSF; k++) {
        const char *const name = trial[k].method.name;
        report_relative(report_beside(&r, REPORT_THEORY), "at rest", name, "jump / (sigma / R)", 1, x[REST].figure[k][JUMP],
                        0.15);
        report_range(report_beside(&r, REPORT_THEORY), "at rest", name, "parasitic currents: mu U / sigma", 0,
                     x[REST].figure[k][CURRENT], 0, 1e-3);
        report_relative(report_beside(&r, REPORT_THEORY), "from a square", name, "length / 2 pi R (square: 1.128)", 1,
                        x[SQUARE].figure[k][LENGTH], 0.05);
        report_relative(report_beside(&r, REPORT_THEORY), "ellipse", name, "period", 1.083, x[ELLIPSE].figure[k][JUMP], 0.12);
        report_relative(report_beside(&r, REPORT_THEORY), "ellipse", name, "stretch after half a period", -0.743,
                        x[ELLIPSE].figure[k][CURRENT], 0.1);
    }
    report_range(report_beside(&r, REPORT_THEORY), "at rest", "CSS", "momentum", 0, x[REST].figure[CSS][MOMENTUM], 0, 1e-10);
    return report_close(&r) ? 1 : 0;
}
