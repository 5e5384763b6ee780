/* SPDX-License-Identifier: MIT
 *
 * dam_break.c - a column of water collapses in a tank, in the terminal.
 *
 *     cc -O2 -I. -o dam_break examples/dam_break.c -lm
 *     ./dam_break                  an animation where the output is a terminal, else a few pictures
 *
 * Weakly compressible SPH: water is a stiff gas, whose density stays within a percent by Tait's equation of
 * state with a sound speed of ten times the largest speed. Three layers of wall particles take their pressure
 * from the water in front of them (sph_wall_adami). The column is A by 2 A, as in Martin & Moyce 1952,
 * Phil. Trans. R. Soc. A 244, 312; the tank is 5 A wide. Lengths are in A, times in sqrt(A / g).
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#else
#define isatty(file) 0
#endif

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, LAYERS = 3, MOST = 2000, COLUMNS = 78, ROWS = 23 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double width = 5, height = 3, g = 1;
static const sph_tait water = {.rho0 = 1, .c = 20, .gamma = 7}; /* the fastest: about 2 */
static double dx, h, dt, t, m;
static int n, n_water; /* water first, then walls */
static double x[MOST], y[MOST], vx[MOST], vy[MOST], ax[MOST], ay[MOST], rho[MOST], p[MOST];
static double is_water[MOST], nx[MOST], ny[MOST];

static void need(sph_index answer) /* what a sweep returns: below 0 an error */
{
    if (answer < 0) fprintf(stderr, "dam_break: t = %g: %s\n", t, sph_status_text((int)answer)), exit(1);
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
    x[n] = px, y[n] = py, is_water[n] = wet;
    nx[n] = (px < 0) - (px > width), ny[n] = py < 0; /* normals of walls, which let water slip along */
    p[n] = wet ? water.rho0 * g * (2 - py) : 0; /* at rest under its weight */
    rho[n] = sph_density_tait(p[n], water), n++;
}
static void fill(int across) /* particles across the column: not more than 20, for MOST in all */
{
    dx = 1.0 / across, h = 1.3 * dx;
    m = water.rho0 * dx * dx;
    dt = sph_time_step_sound(h, water.c, 3);
    for (int j = 0; j < 2 * across; j++)
        for (int i = 0; i < across; i++) add((i + 0.5) * dx, (j + 0.5) * dx, 1);
    n_water = n;
    for (int j = -LAYERS; j < height * across; j++)
        for (int i = -LAYERS; i < width * across + LAYERS; i++)
            if (i < 0 || i >= width * across || j < 0) add((i + 0.5) * dx, (j + 0.5) * dx, 0);
}

static void rates(void) /* continuity for the density, then pressures, then forces */
{
    static double one = 1, zero, divergence[MOST], p_wall[MOST], v_wall_x[MOST], v_wall_y[MOST];
    static void *memory; /* of the search: from step to step */
    static size_t size;
    const sph_points points = sph_points_separate(n, x, y, NULL);
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius), H = sph_scalars_same(&h), mass = sph_scalars_same(&m);
    const sph_scalars density = sph_scalars_array(rho), pressure = sph_scalars_array(p), c = {&water.c, 0};
    const sph_vectors v = sph_vectors_separate(vx, vy, NULL), rest = {{&zero, 0}, {&zero, 0}, {0}};
    const sph_vectors normal = sph_vectors_separate(nx, ny, NULL);
    const sph_medium gas = {mass, density, sph_scalars_same(&one)};
    const sph_fluid fluid = {mass, density, pressure, c, v, SPH_VISCOSITY_MONAGHAN, 0.05, 0, 0.1};
    const sph_wall wall = {sph_scalars_array(is_water), density, pressure, v, rest, normal, {0, -g, 0}};
    const sph_wall_out on_wall = {.p = p_wall, .v = sph_vector_out_separate(v_wall_x, v_wall_y, NULL)};
    const sph_fluid_out force = {.acceleration = sph_vector_out_separate(ax, ay, NULL)};
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, n, found.pairs));
    need(answer);
    /* scanned once, for three sweeps */
    const sph_cloud all = sph_cloud_checked(DIM, sph_cloud_of(points, found.list, H, sph_scalars_none()));
    const sph_cloud wet = sph_cloud_range(all, 0, n_water), walls = sph_cloud_range(all, n_water, n);
    if (EXAMINE && t == 0) examine(all);
    for (int i = n_water; i < n; i++) vx[i] = vy[i] = 0; /* walls stand still, which squeezes water, ... */
    need(sph_divergence_difference(KERNEL, DIM, wet, gas, v, sph_scalar_out_array(divergence, NULL)));
    for (int i = 0; i < n_water; i++) p[i] = sph_pressure_tait(rho[i] -= dt * rho[i] * divergence[i], water);
    need(sph_wall_adami(KERNEL, DIM, walls, wall, on_wall));
    for (int i = n_water; i < n; i++) /* ... push, and move with the water: at rest they would hold it back */
        rho[i] = sph_density_tait(p[i] = fmax(p_wall[i], 0), water), vx[i] = v_wall_x[i], vy[i] = v_wall_y[i];
    need(sph_fluid_rates_monaghan(KERNEL, DIM, wet, fluid, force));
}
static void step(void) /* kick, drift, kick: leapfrog */
{
    for (int i = 0; i < n_water; i++) {
        x[i] += dt * (vx[i] += 0.5 * dt * ax[i]);
        y[i] += dt * (vy[i] += 0.5 * dt * (ay[i] - g));
    }
    rates();
    for (int i = 0; i < n_water; i++) vx[i] += 0.5 * dt * ax[i], vy[i] += 0.5 * dt * (ay[i] - g);
    t += dt;
}

static double front(void)
{
    double most = 0;
    for (int i = 0; i < n_water; i++) most = fmax(most, x[i] + 0.5 * dx);
    return most;
}
static void draw(void) /* the faster, the darker */
{
    char picture[ROWS][COLUMNS + 1];
    memset(picture, ' ', sizeof picture);
    for (int i = 0; i < n_water; i++) {
        const int column = (int)floor(x[i] / width * COLUMNS), row = (int)floor(y[i] / height * ROWS);
        const double speed = sqrt(vx[i] * vx[i] + vy[i] * vy[i]);
        if (row >= 0 && row < ROWS && column >= 0 && column < COLUMNS)
            picture[ROWS - 1 - row][column] = "-=+*#%@@"[speed < 2 ? (int)(3.5 * speed) : 7];
    }
    for (int i = 0; i < ROWS; i++) printf("|%.*s|\n", COLUMNS, picture[i]);
    printf("t sqrt(g / A) = %.2f   front at %.2f A\n", t, front());
}
static double energy(void) /* kinetic and potential: without that of compression, 0.2 % of it */
{
    double sum = 0;
    for (int i = 0; i < n_water; i++) sum += m * (0.5 * (vx[i] * vx[i] + vy[i] * vy[i]) + g * y[i]);
    return sum;
}
static int test(void)
{
    /* Martin & Moyce, table 2: x / A = 2.11 and 3.67 at t sqrt(2 g / A) = 1.83 and 2.98 */
    double most = 0, first, at = 0, slope, depth = 0, floor_p = 0, count = 0;
    double fall[2] = {0}, many[2] = {0}; /* of the outermost column, and of the two beside it */
    int failed = 0, lost = 0;
    fill(12), rates(), first = energy();
    while (t < 2.98 / sqrt(2)) {
        step(), most = fmax(most, energy() / first);
        if (t * sqrt(2) < 1.83) at = front();
    }
    for (int i = 0; i < n_water; i++) {
        lost += !(x[i] > 0 && x[i] < width && y[i] > 0 && y[i] < height);
        if (x[i] < 1) depth = fmax(depth, y[i]);
        if (x[i] < 1 && y[i] < dx) floor_p += p[i], count++;
        if (x[i] < 3 * dx && y[i] > 4 * dx) fall[x[i] > dx] += vy[i], many[x[i] > dx]++;
    }
    floor_p /= water.rho0 * g * depth * count;
    slope = (front() - at) / (2.98 - 1.83);
    if (!(fabs(slope / ((3.67 - 2.11) / (2.98 - 1.83)) - 1) < 0.1))
        failed = printf("FAILED: the front is not within 10 %% of the experiment: %g\n", slope);
    if (!(most < 1.003)) failed = printf("FAILED: energy grows by a factor of %g\n", most);
    if (!(fabs(floor_p - 1) < 0.25))
        failed = printf("FAILED: the floor carries %g of the weight of the water above\n", floor_p);
    if (!(fall[0] / many[0] / (fall[1] / many[1]) > 0.8)) failed = printf("FAILED: water sticks to the wall\n");
    if (lost) failed = printf("FAILED: %d particles are outside of the tank\n", lost);
    return failed ? 1 : puts("ok") < 0;
}
static void run(int csv)
{
    const int terminal = !csv && isatty(1);
    if (csv) printf("t,x,y,vx,vy,p,water\n");
    fill(20);
    rates();
    for (int frame = 0; frame <= 120; frame++) {
        while (t < frame * 0.03) step();
        for (int i = 0; i < n && csv && frame % 40 == 0; i++)
            printf("%.4g,%.5g,%.5g,%.5g,%.5g,%.5g,%g\n", t, x[i], y[i], vx[i], vy[i], p[i], is_water[i]);
        if (terminal) printf("\033[H\033[J");
        if (terminal || (!csv && frame % 40 == 0)) draw();
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
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "dam_break: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("dam_break [-o FILE.csv | -t]   show the flow, write it at four times, or test it") < 0;
}
