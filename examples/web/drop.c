/* SPDX-License-Identifier: MIT
 *
 * drop.c - a drop in another liquid of the same density oscillates by surface tension, as in
 * ../fluids/fluids_drop.c: a periodic box of 1 x 1, a drop of the area of a circle with R = 1/4,
 * rho = 1, c0 = 20.
 */
#include "lab.h"

enum { DIM = 2, SIDE = 64, MOST = SIDE * SIDE };
enum { SHAPE, FORM, SIGMA, NU, STRETCH, ACROSS, CONTROLS };
enum { ELLIPSE, SQUARE };
enum { CSS, CSF };
enum { LIQUID, PRESSURE, SPEED, FIELDS };
enum { STRETCHED, PERIODS, JUMP, KINETIC, MEASURES };
#define KERNEL SPH_WENDLAND_C2
static const double pi = 3.14159265358979324, R = 0.25, one = 1;

static lab_control controls[CONTROLS] = {
    {"shape", "At first", "an ellipse|a square", 0, 1, 1, 0, 0},
    {"form", "Tension", "by the stress (CSS)|by the curvature (CSF)", 0, 1, 1, CSS, 0},
    {"sigma", "Tension sigma", NULL, 0.1, 2, 0.1, 1, 0},
    {"nu", "Viscosity nu", NULL, 0.002, 0.05, 0.002, 0.01, 0},
    {"stretch", "Long axis / R", NULL, 1, 1.6, 0.05, 1.3, 0},
    {"across", "Particles in a row", NULL, 20, SIDE, 2, 36, 0}};
static double x[MOST], y[MOST], vx[MOST], vy[MOST], ax[MOST], ay[MOST], rho[MOST], p[MOST], colour[MOST],
    speed[MOST], mu[MOST], volume[MOST], tension_x[MOST], tension_y[MOST], steepness[MOST], dx, h, m, dt;
static int n;
static sph_tait liquid = {1, 20, 1, 0};
static double from_x, from_y; /* of the pointer */

static int inside(double px, double py)
{
    const double side = 0.5 * sqrt(pi) * R, stretch = controls[STRETCH].value;
    if (controls[SHAPE].value > 0) return fabs(px) < side && fabs(py) < side;
    return px * px / (stretch * stretch) + py * py * stretch * stretch < R * R;
}
static int rates(void)
{
    static double rate[MOST], normal_x[MOST], normal_y[MOST], smooth[MOST], viscous_x[MOST], viscous_y[MOST];
    const sph_points points = sph_points_periodic(sph_points_separate(n, x, y, NULL), 1, 1, 0);
    const double radius = sph_kernel_support(KERNEL, h);
    const sph_scalars density = sph_scalars_array(rho);
    const sph_vectors v = sph_vectors_separate(vx, vy, NULL);
    const sph_medium medium = {sph_scalars_same(&m), density, sph_scalars_same(&one)};
    const int by_curvature = controls[FORM].value == CSF;
    sph_fluid fluid = {0};
    sph_fluid_out forces = {0};
    sph_tension tension = {0};
    sph_tension_out out = {0};
    sph_list list = {NULL, NULL};
    sph_cloud cloud;
    int i;
    LAB_TRY(lab_neighbours(DIM, points, sph_scalars_same(&radius), SPH_GATHER, &list));
    cloud =
        sph_cloud_checked(DIM, sph_cloud_of(points, list, sph_scalars_same(&h), sph_scalars_array(volume)));
    LAB_TRY(sph_divergence_difference(KERNEL, DIM, cloud, medium, v, sph_scalar_out_array(rate, NULL)));
    for (i = 0; i < n; i++) {
        rho[i] -= dt * rho[i] * rate[i];
        p[i] = sph_pressure_tait(rho[i], liquid);
        volume[i] = m / rho[i];
        mu[i] = controls[NU].value * liquid.rho0;
    }
    fluid.m = sph_scalars_same(&m);
    fluid.rho = density;
    fluid.p = sph_scalars_array(p);
    fluid.c = sph_scalars_same(&liquid.c);
    fluid.v = v;
    forces.acceleration = sph_vector_out_separate(ax, ay, NULL);
    LAB_TRY(sph_fluid_rates_colagrossi(KERNEL, DIM, cloud, fluid, forces));
    LAB_TRY(sph_viscosity_mu_monaghan_cleary(KERNEL, DIM, cloud, fluid, sph_scalars_array(mu),
                                             sph_vector_out_separate(viscous_x, viscous_y, NULL)));
    if (by_curvature)
        LAB_TRY(sph_interpolate_shepard(KERNEL, DIM, cloud, sph_scalars_array(colour),
                                        sph_scalar_out_array(smooth, NULL)));
    LAB_TRY(sph_gradient_difference(KERNEL, DIM, cloud, sph_scalars_array(by_curvature ? smooth : colour),
                                    sph_vector_out_separate(normal_x, normal_y, NULL)));
    tension.rho = density;
    tension.normal = sph_vectors_separate(normal_x, normal_y, NULL);
    tension.sigma = controls[SIGMA].value;
    out.acceleration = sph_vector_out_separate(tension_x, tension_y, NULL);
    if (by_curvature) LAB_TRY(sph_tension_csf(KERNEL, DIM, cloud, tension, out));
    else LAB_TRY(sph_tension_css(KERNEL, DIM, cloud, tension, out.acceleration));
    for (i = 0; i < n; i++) {
        ax[i] += viscous_x[i] + tension_x[i];
        ay[i] += viscous_y[i] + tension_y[i];
        steepness[i] = normal_x[i] * normal_x[i] + normal_y[i] * normal_y[i];
    }
    return 0;
}
static void longest_step(void)
{
    const double stiff = 3 * controls[NU].value; /* what Monaghan & Cleary's form has against compression */
    dt = fmin(sph_time_step_sound(h, liquid.c, 1), sph_time_step_viscous_nu(h, stiff));
}
static int reset(void)
{
    const int across = (int)controls[ACROSS].value;
    int i;
    n = across * across;
    dx = 1.0 / across;
    h = 1.6 * dx;
    m = liquid.rho0 * dx * dx;
    liquid.p0 = 2 * controls[SIGMA].value / R;
    dt = 0;
    lab_seed(7);
    for (i = 0; i < n; i++) {
        const double jx = 0.02 * lab_random(), jy = 0.02 * lab_random();
        x[i] = (i % across + 0.5 + jx) * dx;
        y[i] = (i / across + 0.5 + jy) * dx;
        vx[i] = vy[i] = 0;
        rho[i] = liquid.rho0;
        volume[i] = m / rho[i];
        colour[i] = inside(x[i] - 0.5, y[i] - 0.5);
    }
    lab_drop.n = lab_drop.n_moving = n;
    lab_drop.size = dx;
    lab_drop.time = 0;
    LAB_TRY(rates());
    longest_step();
    return 0;
}
static int step(void) /* kick, drift, kick: leapfrog */
{
    int i;
    longest_step();
    for (i = 0; i < n; i++) {
        x[i] += dt * (vx[i] += 0.5 * dt * ax[i]);
        y[i] += dt * (vy[i] += 0.5 * dt * ay[i]);
        x[i] -= floor(x[i]);
        y[i] -= floor(y[i]);
    }
    LAB_TRY(rates());
    for (i = 0; i < n; i++) {
        vx[i] += 0.5 * dt * ax[i];
        vy[i] += 0.5 * dt * ay[i];
    }
    lab_drop.time += dt;
    return 0;
}
static lab_field fields[FIELDS] = {
    {"which liquid", colour, 0, 1}, {"pressure", p, 0, 0}, {"speed", speed, 0, 0.8}};
static lab_measure measures[MEASURES] = {{"<x^2 - y^2> / R^2 over the drop", 0},
                                         {"time, in periods of small waves without viscosity", 0},
                                         {"jump of the pressure / (sigma / R)", 0},
                                         {"kinetic energy", 0}};
static int look(void)
{
    const double period = 2 * pi * sqrt(2 * R * R * R / (6 * controls[SIGMA].value));
    double sum[2] = {0, 0}, count[2] = {0, 0}, stretched = 0, drop = 0;
    int i;
    measures[KINETIC].value = 0;
    for (i = 0; i < n; i++) {
        const double v2 = vx[i] * vx[i] + vy[i] * vy[i], px = x[i] - 0.5, py = y[i] - 0.5;
        const int in = colour[i] > 0.5;
        speed[i] = sqrt(v2);
        measures[KINETIC].value += 0.5 * m * v2;
        stretched += colour[i] * (px * px - py * py);
        drop += colour[i];
        if (steepness[i] * h * h > 1e-4) continue; /* near the interface */
        sum[in] += p[i];
        count[in]++;
    }
    measures[STRETCHED].value = stretched / drop / (R * R);
    measures[PERIODS].value = lab_drop.time / period;
    measures[JUMP].value = count[0] > 0 && count[1] > 0
                               ? (sum[1] / count[1] - sum[0] / count[0]) * R / controls[SIGMA].value
                               : 0;
    return 0;
}
static int changed(int control) { return control == FORM || control == NU ? 0 : reset(); }
static int point(int phase, double px, double py) /* what is near is taken along */
{
    int i;
    if (phase == LAB_MOVE)
        for (i = 0; i < n; i++) {
            const double q =
                fmax(0, 1 - ((x[i] - px) * (x[i] - px) + (y[i] - py) * (y[i] - py)) / (0.1 * 0.1));
            vx[i] += q * fmax(-1, fmin(1, 5 * (px - from_x)));
            vy[i] += q * fmax(-1, fmin(1, 5 * (py - from_y)));
        }
    from_x = px;
    from_y = py;
    return 0;
}
lab_scene lab_drop = {
    .name = "drop",
    .title = "Oscillating drop",
    .about = "Surface tension pulls a drop back to a circle, and beyond it. Two liquids of the same "
             "density in a periodic box; the period of small waves is known (Lamb), and so is the jump of "
             "the pressure, sigma / R (Laplace).",
    .hint = "Press and move to push the liquid.",
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
