/* SPDX-License-Identifier: MIT
 *
 * dam.c - a dam breaks, as in ../delta_dam.c, with all that can be switched while it runs: kernel, smoothing
 * length, remedies against clustering; walls that are dragged, and water that is poured. Lengths are in A,
 * the width of the column, times in sqrt(A / g).
 */
#include "lab.h"

enum { DIM = 2, LAYERS = 4, MOST = 16000 };
enum { KERNEL, H_OVER_DX, ACROSS, REMEDY, ALPHA, LEFT, RIGHT, CONTROLS };
enum { NONE, CONVEX, COLLISIONS, SHIFTING, DELTA, DELTA_AND_SHIFTING };
enum { SPEED, PRESSURE, DENSITY, FIELDS };
enum { WATER, FRONT, FASTEST, CROWDED, STEP, MEASURES };
static const double width = 5, height = 3, g = 1;
static const sph_tait water = {1, 20, 7, 0}; /* the fastest particle: about 2 */

static lab_control controls[CONTROLS] = {
    {"kernel", "Kernel", LAB_KERNEL_NAMES, 0, SPH_KERNEL_COUNT - 1, 1, SPH_WENDLAND_C2, 0},
    {"h", "Smoothing length h / spacing", NULL, 0.9, 2.2, 0.05, 1.3, 0},
    {"across", "Particles across the column", NULL, 12, 56, 1, 30, 0},
    {"remedy", "Remedy", "none|convex kernel|collisions|shifting|delta-SPH|delta-SPH and shifting", 0, 5, 1,
     NONE, 0},
    {"alpha", "Viscosity alpha", NULL, 0, 0.3, 0.01, 0.05, 0},
    {"left", "Left wall", NULL, 0, 1.5, 0.05, 0, 0},
    {"right", "Right wall", NULL, 2, 5, 0.05, 5, 0}};

static double dx, h, dt, m;
static int n_water; /* water first, then walls */
/* is_water, side: 1 for water; -1 and 1 for the walls that move; u: velocity of walls */
static double x[MOST], y[MOST], vx[MOST], vy[MOST], ax[MOST], ay[MOST], rho[MOST], p[MOST], is_water[MOST],
    side[MOST], nx[MOST], ny[MOST], u[MOST];
static double *const carried[] = {x, y, vx, vy, ax, ay, rho, p, is_water, side, nx, ny, u};
static double volume[MOST], zero[MOST], inverse_mass[MOST], speed[MOST], ratio[MOST];
static double at[2]; /* of the left and of the right wall */
static int dragged;  /* -1, 1: a wall; 0: none */
static int pours;    /* water, at (pour_x, pour_y) */
static double pour_x, pour_y, next_drop;

static int copy(int from, int to)
{
    int c;
    for (c = 0; c < (int)(sizeof carried / sizeof *carried); c++) carried[c][to] = carried[c][from];
    return to;
}
static int put(int i, double px, double py, int wet)
{
    x[i] = px;
    y[i] = py;
    vx[i] = vy[i] = ax[i] = u[i] = side[i] = 0;
    ay[i] = g; /* held until now */
    is_water[i] = wet;
    nx[i] = ny[i] = 0;
    p[i] = 0;
    rho[i] = water.rho0;
    return i;
}
static int add_wall(double px, double py, int which)
{
    if (lab_dam.n == MOST) return SPH_ERROR_CAPACITY;
    put(lab_dam.n, px, py, 0);
    side[lab_dam.n] = which;
    nx[lab_dam.n] = -which; /* along walls water slips */
    ny[lab_dam.n] = which == 0;
    return lab_dam.n++;
}
static int add_water(double px, double py) /* the first wall particle makes room */
{
    if (lab_dam.n == MOST) return SPH_ERROR_CAPACITY;
    copy(n_water, lab_dam.n++);
    lab_dam.n_moving = n_water + 1;
    return put(n_water++, px, py, 1);
}
static void remove_water(int i)
{
    copy(n_water - 1, i);
    copy(--lab_dam.n, --n_water);
    lab_dam.n_moving = n_water;
}
static int reset(void)
{
    const int across = (int)controls[ACROSS].value, wide = (int)(width * across + 0.5),
              high = (int)(height * across + 0.5);
    int i, j;
    dx = 1.0 / across;
    m = water.rho0 * dx * dx;
    dt = lab_dam.time = next_drop = 0;
    lab_dam.n = n_water = dragged = pours = 0;
    at[0] = controls[LEFT].value;
    at[1] = controls[RIGHT].value;
    if (at[0] + 1 > at[1]) return SPH_ERROR_VALUE;
    for (j = 0; j < 2 * across; j++)
        for (i = 0; i < across; i++) {
            const int new = add_water(at[0] + (i + 0.5) * dx, (j + 0.5) * dx);
            if (new < 0) return new;
            p[new] = water.rho0 * g * (2 - y[new]); /* at rest under its weight */
            rho[new] = sph_density_tait(p[new], water);
        }
    for (j = -LAYERS; j < 0; j++)
        for (i = -LAYERS; i < wide + LAYERS; i++) LAB_TRY(add_wall((i + 0.5) * dx, (j + 0.5) * dx, 0));
    for (j = 0; j < high; j++)
        for (i = 0; i < LAYERS; i++) {
            LAB_TRY(add_wall(at[0] - (i + 0.5) * dx, (j + 0.5) * dx, -1));
            LAB_TRY(add_wall(at[1] + (i + 0.5) * dx, (j + 0.5) * dx, 1));
        }
    lab_dam.size = dx;
    return 0;
}

/* ---------------------------------------------------------------- a step */

/* Walls go to where they are wanted, not faster than half of sqrt(g A). */
static void move_walls(void)
{
    const double longest = 0.5 * dt;
    int s, i;
    for (s = 0; s < 2; s++) {
        const double way = fmax(-longest, fmin(longest, controls[s ? RIGHT : LEFT].value - at[s]));
        at[s] += way;
        for (i = n_water; i < lab_dam.n; i++)
            if (side[i] == (s ? 1 : -1)) {
                x[i] += way;
                u[i] = dt > 0 ? way / dt : 0;
            }
    }
}
static void pour(void) /* a row of seven, where there is room */
{
    int k, i;
    if (!pours || lab_dam.time < next_drop || lab_dam.n + 7 > MOST) return;
    next_drop = lab_dam.time + dx;
    for (k = -3; k <= 3; k++) {
        const double px = pour_x + k * dx;
        int room = px > at[0] + dx && px < at[1] - dx && pour_y > dx;
        for (i = 0; i < n_water && room; i++)
            room = (x[i] - px) * (x[i] - px) + (y[i] - pour_y) * (y[i] - pour_y) > 0.8 * dx * dx;
        if (room) vy[add_water(px, pour_y)] = -1;
    }
}
/* Rates of the kernel K: the density first, then the walls, then the forces, then where particles are
   shifted. */
#define SWEEPS(K) answer = sweeps(K, cloud, fastest)
static inline __attribute__((always_inline)) int sweeps(sph_kernel k, sph_cloud all, double fastest)
{
    static double one = 1, rate[MOST], slope_x[MOST], slope_y[MOST], p_wall[MOST], v_wall_x[MOST],
                  v_wall_y[MOST];
    const int remedy = (int)controls[REMEDY].value, n = lab_dam.n;
    const sph_cloud wet = sph_cloud_range(all, 0, n_water), walls = sph_cloud_range(all, n_water, n);
    const sph_scalars mass = sph_scalars_same(&m), density = sph_scalars_array(rho),
                      pressure = sph_scalars_array(p);
    const sph_vectors v = sph_vectors_separate(vx, vy, NULL), velocity = sph_vectors_separate(u, zero, NULL);
    const sph_medium gas = {mass, density, sph_scalars_same(&one)};
    const sph_fluid fluid = {
        mass, density, pressure, sph_scalars_same(&water.c), v, SPH_VISCOSITY_MONAGHAN, controls[ALPHA].value,
        0,    0.1};
    const sph_wall wall = {sph_scalars_array(is_water),        density,   pressure, v, velocity,
                           sph_vectors_separate(nx, ny, NULL), {0, -g, 0}};
    const sph_wall_out on_wall = {p_wall, sph_vector_out_separate(v_wall_x, v_wall_y, NULL), 1, NULL};
    sph_fluid_out forces = {0};
    int i;
    for (i = n_water; i < n; i++) vx[i] = u[i], vy[i] = 0; /* as walls squeeze water */
    if (remedy == DELTA || remedy == DELTA_AND_SHIFTING) {
        sph_derivatives_out slope = {0};
        sph_diffusion diffusion = {0};
        slope.gx = slope_x;
        slope.gy = slope_y;
        LAB_TRY(sph_gradient_cspm(k, DIM, all, density, slope));
        diffusion.fluid = fluid;
        diffusion.tait = water;
        diffusion.share = sph_scalars_array(is_water);
        diffusion.gradient = sph_vectors_separate(slope_x, slope_y, NULL);
        LAB_TRY(sph_density_diffusion_antuono(k, DIM, wet, diffusion, sph_scalar_out_array(rate, NULL)));
    } else {
        LAB_TRY(sph_divergence_difference(k, DIM, wet, gas, v, sph_scalar_out_array(rate, NULL)));
        for (i = 0; i < n_water; i++) rate[i] *= -rho[i];
    }
    for (i = 0; i < n_water; i++) {
        /* water stays within a percent; a drop that is caught between others, or that meets one that is being
           poured, would not, and end the run */
        rho[i] = fmax(0.9 * water.rho0, fmin(1.1 * water.rho0, rho[i] + dt * rate[i]));
        p[i] = sph_pressure_tait(rho[i], water);
    }

    LAB_TRY(sph_wall_adami(k, DIM, walls, wall, on_wall));
    for (i = n_water; i < n; i++) { /* they push, and move with the water: at rest they would hold it back */
        rho[i] = sph_density_tait(p[i] = fmax(p_wall[i], 0), water);
        vx[i] = v_wall_x[i];
        vy[i] = v_wall_y[i];
    }
    forces.acceleration = sph_vector_out_separate(ax, ay, NULL);
    LAB_TRY(sph_fluid_rates_monaghan(k, DIM, wet, fluid, forces));

    if (remedy == SHIFTING || remedy == DELTA_AND_SHIFTING) {
        static double lambda[MOST], strength, surface_x[MOST], surface_y[MOST], shift_x[MOST], shift_y[MOST];
        sph_surface_out surface = {0};
        sph_shift shift = {0};
        surface.eigenvalue = lambda;
        surface.normal = sph_vector_out_separate(surface_x, surface_y, NULL);
        LAB_TRY(sph_free_surface(k, DIM, wet, surface));
        strength = sph_shift_strength_sun(h, dt * fastest, h);
        shift.strength = sph_scalars_same(&strength);
        shift.tensile = 0.2;
        shift.spacing = dx / h;
        shift.eigenvalue = sph_scalars_array(lambda);
        shift.normal = sph_vectors_separate(surface_x, surface_y, NULL);
        LAB_TRY(sph_shift_displacement(k, DIM, wet, shift, sph_vector_out_separate(shift_x, shift_y, NULL)));
        for (i = 0; i < n_water; i++) {
            x[i] += shift_x[i];
            y[i] += shift_y[i];
        }
    }
    return 0;
}
static int make_cloud(sph_kernel k, sph_cloud *cloud)
{
    const sph_points points = sph_points_separate(lab_dam.n, x, y, NULL);
    const double radius = sph_kernel_support(k, h);
    sph_list list = {NULL, NULL};
    int i;
    for (i = 0; i < lab_dam.n; i++) volume[i] = m / rho[i];
    LAB_TRY(lab_neighbours(DIM, points, sph_scalars_same(&radius), SPH_GATHER, &list));
    *cloud =
        sph_cloud_checked(DIM, sph_cloud_of(points, list, sph_scalars_same(&h), sph_scalars_array(volume)));
    return 0;
}
static sph_kernel kernel(void)
{
    return controls[REMEDY].value == CONVEX ? SPH_CONVEX : (sph_kernel)controls[KERNEL].value;
}
static int step(void) /* kick, drift, kick: leapfrog */
{
    double fastest = 0, hardest = 0;
    int i, answer = 0;
    sph_cloud cloud;
    h = controls[H_OVER_DX].value * dx;
    for (i = 0; i < n_water; i++) {
        fastest = fmax(fastest, vx[i] * vx[i] + vy[i] * vy[i]);
        hardest = fmax(hardest, ax[i] * ax[i] + (ay[i] - g) * (ay[i] - g));
    }
    fastest = sqrt(fastest);
    dt = fmin(sph_time_step_sound(h, water.c, fmax(fastest, 3)), sph_time_step_force(h, sqrt(hardest)));
    move_walls();
    for (i = 0; i < n_water; i++) {
        x[i] += dt * (vx[i] += 0.5 * dt * ax[i]);
        y[i] += dt * (vy[i] += 0.5 * dt * (ay[i] - g));
    }
    LAB_TRY(make_cloud(kernel(), &cloud));
    LAB_SWITCH_KERNEL(kernel(), SWEEPS)
    LAB_TRY(answer);
    for (i = 0; i < n_water; i++) {
        vx[i] += 0.5 * dt * ax[i];
        vy[i] += 0.5 * dt * (ay[i] - g);
    }
    if (controls[REMEDY].value == COLLISIONS) {
        const sph_collision bounce = {0.85 * dx, 0.01, sph_scalars_array(inverse_mass)};
        for (i = 0; i < lab_dam.n; i++) inverse_mass[i] = is_water[i] / m;
        for (i = n_water; i < lab_dam.n; i++) vx[i] = u[i], vy[i] = 0;
        LAB_TRY(sph_collision_sequential(DIM, sph_cloud_range(cloud, 0, n_water), bounce,
                                         sph_vector_out_separate(vx, vy, NULL), NULL));
    }
    lab_dam.time += dt;
    for (i = n_water - 1; i >= 0; i--) /* over a wall, and away */
        if (!(x[i] > -LAYERS * dx && x[i] < width + LAYERS * dx && y[i] > -LAYERS * dx && y[i] < 4 * height))
            remove_water(i);
    pour();
    return 0;
}

/* ---------------------------------------------------------------- what a host asks for */

static lab_field fields[FIELDS] = {
    {"speed", speed, 0, 2.2}, {"pressure", p, 0, 2}, {"density / rho0 - 1", ratio, -0.02, 0.02}};
static lab_measure measures[MEASURES] = {{"particles of water", 0},
                                         {"front / A", 0},
                                         {"fastest / sqrt(g A)", 0},
                                         {"nearer than half a spacing, %", 0},
                                         {"time step", 0}};
static int look(void)
{
    static double nearest[MOST];
    sph_cloud cloud;
    int i;
    h = controls[H_OVER_DX].value * dx;
    LAB_TRY(make_cloud(kernel(), &cloud));
    LAB_TRY(sph_nearest_distance(DIM, sph_cloud_range(cloud, 0, n_water), cloud.points,
                                 sph_scalar_out_array(nearest, NULL)));
    for (i = 0; i < MEASURES; i++) measures[i].value = 0;
    for (i = 0; i < lab_dam.n; i++) {
        speed[i] = sqrt(vx[i] * vx[i] + vy[i] * vy[i]);
        ratio[i] = rho[i] / water.rho0 - 1;
    }
    for (i = 0; i < n_water; i++) {
        measures[FRONT].value = fmax(measures[FRONT].value, x[i] + 0.5 * dx - at[0]);
        measures[FASTEST].value = fmax(measures[FASTEST].value, speed[i]);
        measures[CROWDED].value += 100.0 / n_water * (nearest[i] > 0 && nearest[i] < 0.5 * dx);
    }
    measures[WATER].value = n_water;
    measures[STEP].value = dt;
    return 0;
}
static int changed(int control)
{
    if (control == KERNEL)
        controls[H_OVER_DX].value = sph_kernel_h_over_dx((sph_kernel)controls[KERNEL].value);
    if (control == REMEDY && controls[REMEDY].value == CONVEX)
        controls[H_OVER_DX].value = sph_kernel_h_over_dx(SPH_CONVEX);
    return control == ACROSS ? reset() : 0;
}
static double within(int control, double value)
{
    return fmax(controls[control].least, fmin(controls[control].most, value));
}
static int point(int phase, double px, double py)
{
    if (phase == LAB_DOWN) {
        dragged = fabs(px - at[1]) < 0.15 || px > at[1] ? 1 : fabs(px - at[0]) < 0.15 || px < at[0] ? -1 : 0;
        pours = !dragged;
    }
    if (phase == LAB_UP) dragged = pours = 0;
    if (dragged > 0) controls[RIGHT].value = within(RIGHT, px);
    if (dragged < 0) controls[LEFT].value = within(LEFT, px);
    pour_x = px;
    pour_y = py;
    return 0;
}
lab_scene lab_dam = {
    .name = "dam",
    .title = "Dam break",
    .about = "A column of water collapses in a tank: weakly compressible SPH with walls of Adami, Hu & "
             "Adams (2012). The plain method lets particles cluster and the pressure is noisy; each "
             "remedy can be seen to work.",
    .hint = "Drag the left or the right wall, or press anywhere else to pour water.",
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
    .view = {-0.2, -0.2, 5.4, 3.24},
    .x = x,
    .y = y,
};
