/* SPDX-License-Identifier: MIT
 *
 * delta_dam.c - a dam breaks, with all that keeps a violent flow smooth: to copy from.
 *
 *     cc -O2 -I. -o delta_dam examples/delta_dam.c -lm
 *     ./delta_dam -o dam.csv
 *
 * Beside dam_break.c this has density diffusion (delta-SPH, Antuono et al. 2010), which takes the noise from the
 * pressure; shifting (Sun et al. 2017), which keeps particles apart, and knows the free surface; and a time step
 * from sound and forces. Walls: Adami et al. 2012. The table has the flow without diffusion and shifting (smooth
 * = 0), and with them. The column is A by 2 A, times are in sqrt(A / g). More: examples/fluids/README.md.
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, LAYERS = 4, MOST = 1500 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double width = 4, height = 3, g = 1;
static const sph_tait water = {.rho0 = 1, .c = 20, .gamma = 7}; /* the fastest: about 2 */
static int smooth, n, n_water, steps; /* smooth = 0: no diffusion, no shifting; water first, then walls */
static double dx, h, dt, t, m;
static double x[MOST], y[MOST], vx[MOST], vy[MOST], ax[MOST], ay[MOST], rho[MOST], p[MOST], volume[MOST];
static double is_water[MOST], nx[MOST], ny[MOST], lambda[MOST]; /* lambda: 1 inside, less at the surface */

static void need(sph_index answer) /* what a sweep returns: below 0 an error */
{
    if (answer < 0) fprintf(stderr, "delta_dam: t = %g: %s\n", t, sph_status_text((int)answer)), exit(1);
}
static void examine(sph_cloud given) /* with both sides of pairs: forces are symmetric */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 1, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}
static void add(double px, double py, int wet)
{
    x[n] = px, y[n] = py, vx[n] = vy[n] = ax[n] = 0, ay[n] = g, is_water[n] = wet; /* held until now */
    nx[n] = (px < 0) - (px > width), ny[n] = (py < 0) - (py > height); /* along walls water slips */
    p[n] = wet ? water.rho0 * g * (2 - py) : 0; /* at rest under its weight */
    rho[n] = sph_density_tait(p[n], water), n++;
}
static void fill(int across) /* particles across the column: not more than 16, for MOST in all */
{
    dx = 1.0 / across, h = 1.6 * dx, m = water.rho0 * dx * dx, n = 0, t = 0, dt = 0, steps = 0;
    for (int j = 0; j < 2 * across; j++)
        for (int i = 0; i < across; i++) add((i + 0.5) * dx, (j + 0.5) * dx, 1);
    n_water = n;
    for (int j = -LAYERS; j < height * across + LAYERS; j++)
        for (int i = -LAYERS; i < width * across + LAYERS; i++)
            if (i < 0 || i >= width * across || j < 0 || j >= height * across)
                add((i + 0.5) * dx, (j + 0.5) * dx, 0);
}
static sph_cloud neighbours(void) /* scanned once, for all sweeps of a step */
{
    static void *memory; /* of the search: from step to step */
    static size_t size;
    const sph_points points = sph_points_separate(n, x, y, NULL);
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius), H = sph_scalars_same(&h), V = sph_scalars_array(volume);
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, n, found.pairs));
    need(answer);
    for (int i = 0; i < n; i++) volume[i] = m / rho[i];
    return sph_cloud_checked(DIM, sph_cloud_of(points, found.list, H, V));
}
static void step(double longest) /* kick, drift, kick: leapfrog */
{
    static double zero, grad_x[MOST], grad_y[MOST], rate[MOST], p_wall[MOST], v_wall_x[MOST], v_wall_y[MOST];
    static double strength, surface_x[MOST], surface_y[MOST], shift_x[MOST], shift_y[MOST];
    const sph_scalars density = sph_scalars_array(rho), pressure = sph_scalars_array(p), c = {&water.c, 0};
    const sph_vectors v = sph_vectors_separate(vx, vy, NULL), rest = {{&zero, 0}, {&zero, 0}, {0}};
    const sph_fluid fluid = {{&m, 0}, density, pressure, c, v, SPH_VISCOSITY_MONAGHAN, 0.02, 0, 0.1};
    double fastest = 0, hardest = 0; /* of velocities and accelerations */
    for (int i = 0; i < n_water; i++) {
        fastest = fmax(fastest, sqrt(vx[i] * vx[i] + vy[i] * vy[i]));
        hardest = fmax(hardest, sqrt(ax[i] * ax[i] + (ay[i] - g) * (ay[i] - g)));
    }
    dt = fmin(longest, fmin(1.5 * sph_time_step_sound(h, water.c, fastest), sph_time_step_force(h, hardest)));
    for (int i = 0; i < n_water; i++) {
        x[i] += dt * (vx[i] += 0.5 * dt * ax[i]);
        y[i] += dt * (vy[i] += 0.5 * dt * (ay[i] - g));
    }
    const sph_cloud all = neighbours(), wet = sph_cloud_range(all, 0, n_water);
    if (EXAMINE && steps == 0) examine(all);

    /* density: its gradient, for the diffusion; walls stand still, which squeezes water, and do not diffuse */
    for (int i = n_water; i < n; i++) vx[i] = vy[i] = 0;
    const sph_derivatives_out slope = {.gx = grad_x, .gy = grad_y};
    need(sph_gradient_cspm(KERNEL, DIM, all, density, slope));
    const sph_diffusion diffusion = {.fluid = fluid, .delta = smooth ? 0.1 : -1, .tait = water,
                                     .share = sph_scalars_array(is_water),
                                     .gradient = sph_vectors_separate(grad_x, grad_y, NULL)};
    need(sph_density_diffusion_antuono(KERNEL, DIM, wet, diffusion, sph_scalar_out_array(rate, NULL)));
    for (int i = 0; i < n_water; i++) p[i] = sph_pressure_tait(rho[i] += dt * rate[i], water);

    /* walls push, and move with the water: at rest they would hold it back */
    const sph_wall wall = {sph_scalars_array(is_water), density, pressure, v, rest,
                           sph_vectors_separate(nx, ny, NULL), {0, -g, 0}};
    const sph_wall_out on_wall = {.p = p_wall, .v = sph_vector_out_separate(v_wall_x, v_wall_y, NULL)};
    need(sph_wall_adami(KERNEL, DIM, sph_cloud_range(all, n_water, n), wall, on_wall));
    for (int i = n_water; i < n; i++)
        rho[i] = sph_density_tait(p[i] = fmax(p_wall[i], 0), water), vx[i] = v_wall_x[i], vy[i] = v_wall_y[i];

    const sph_fluid_out forces = {.acceleration = sph_vector_out_separate(ax, ay, NULL)};
    need(sph_fluid_rates_monaghan(KERNEL, DIM, wet, fluid, forces));
    for (int i = 0; i < n_water; i++) vx[i] += 0.5 * dt * ax[i], vy[i] += 0.5 * dt * (ay[i] - g);

    /* shifting: along the surface where there is one, and no spray (a drop alone has no normal) */
    const sph_surface_out surface = {.eigenvalue = lambda,
                                     .normal = sph_vector_out_separate(surface_x, surface_y, NULL)};
    need(sph_free_surface(KERNEL, DIM, wet, surface));
    const sph_shift shift = {.strength = sph_scalars_same(&strength), .tensile = 0.2, .spacing = dx / h,
                             .eigenvalue = sph_scalars_array(lambda),
                             .normal = sph_vectors_separate(surface_x, surface_y, NULL)};
    strength = sph_shift_strength_sun(h, dt * fastest, h);
    need(sph_shift_displacement(KERNEL, DIM, wet, shift, sph_vector_out_separate(shift_x, shift_y, NULL)));
    for (int i = 0; i < n_water && smooth; i++) x[i] += shift_x[i], y[i] += shift_y[i];
    t += dt, steps++;
}
static double noise, crowded; /* rms of p less a linear fit to it; share of particles that nearly meet */
static void measure(void)
{
    static double fit[MOST], nearest[MOST];
    const sph_cloud all = neighbours(), wet = sph_cloud_range(all, 0, n_water);
    const sph_interpolation_options steady = {.conditioning_min = 1e-3};
    const sph_interpolation_out out = {.value = fit};
    const sph_sources sources = {all.points, all.volume};
    need(sph_interpolate_mls(KERNEL, DIM, wet, sources, sph_scalars_array(p), steady, out));
    need(sph_nearest_distance(DIM, wet, all.points, sph_scalar_out_array(nearest, NULL)));
    noise = crowded = 0;
    for (int i = 0; i < n_water; i++) {
        noise += (p[i] - fit[i]) * (p[i] - fit[i]) * (fit[i] != 0) / n_water;
        crowded += (nearest[i] > 0 && nearest[i] < 0.5 * dx) / (double)n_water;
    }
    noise = sqrt(noise) / (water.rho0 * g);
}
static int test(void)
{
    double rough[2], close[2];
    int failed = 0;
    for (smooth = 0; smooth < 2; smooth++) {
        for (fill(12); t < 1.2;) step(1.2 - t);
        measure(), rough[smooth] = noise;
        while (t < 2.4) step(2.4 - t);
        measure(), close[smooth] = crowded;
        for (int i = 0; i < n_water; i++)
            if (!(x[i] > 0 && x[i] < width && y[i] > 0 && y[i] < height))
                failed = printf("FAILED: particle %d is outside of the tank\n", i);
    }
    if (!(rough[1] < 0.2 * rough[0])) failed = printf("FAILED: noise of %g, %g\n", rough[0], rough[1]);
    if (!(close[0] > 0.05 && close[1] < 0.01)) failed = printf("FAILED: crowded: %g, %g\n", close[0], close[1]);
    return failed ? 1 : puts("ok") < 0;
}
static void run(int csv) /* at two times, without and with what makes the flow smooth */
{
    if (csv) printf("smooth,t,x,y,vx,vy,p,water,lambda\n");
    for (int k = 0; k < 4; k++) {
        const double until = k % 2 ? 2.4 : 1.2;
        if (smooth = k / 2, k % 2 == 0) fill(16);
        while (t < until)
            if (step(until - t), csv && (steps % 50 == 0 || t == until)) /* progress */
                fprintf(stderr, "\rsmooth = %d, t = %.2f, dt = %.5f %s", smooth, t, dt, t == until ? "\n" : "");
        for (int i = 0; i < n && csv; i++)
            printf("%d,%.4g,%.5g,%.5g,%.5g,%.5g,%.5g,%g,%.4g\n", smooth, t, x[i], y[i], vx[i], vy[i], p[i],
                   is_water[i], lambda[i]);
        if (measure(), !csv)
            printf("%s: t sqrt(g / A) = %.1f, noise of p %.3f rho g A, crowded %.1f %%\n",
                   smooth ? "smooth" : "plain", t, noise, 100 * crowded);
    }
}
static int save(const char *name) /* as NAME.part, renamed when it is whole; a device is written as it is */
{
    char part[4096];
    snprintf(part, sizeof part, "%.4000s%s", name, strncmp(name, "/dev/", 5) ? ".part" : "");
    if (!setlocale(LC_NUMERIC, "C") || !freopen(part, "wb", stdout)) return perror(name), 2; /* no "1,5" */
    run(1);
    if (!ferror(stdout) && !fclose(stdout) && (!rename(part, name) || (!remove(name) && !rename(part, name))))
        return 0;
    return perror(name), strcmp(part, name) && remove(part), 2;
}
int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc == 1) return run(0), 0;
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "delta_dam: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("delta_dam [-o FILE.csv | -t]   show the flow, write it at two times, or test it") < 0;
}
