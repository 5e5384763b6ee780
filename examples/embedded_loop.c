/* SPDX-License-Identifier: MIT
 *
 * embedded_loop.c - water in a box of 16 x 16 lights runs to wherever is down, on a microcontroller.
 *
 *     cc -O2 -I. -o embedded_loop examples/embedded_loop.c -lm
 *     ./embedded_loop
 *
 * Single precision, static buffers of known size, no heap, no stdio in the loop, one answer for the caller:
 * what a firmware needs. loop() takes the reading of an accelerometer and sets the lights; main() stands
 * for the board: it turns the box by 90 degrees and, where there is a terminal, prints.
 */
#define SPH_SINGLE 1 /* sph_real is float, everywhere */
#define SPH_CHECK 0  /* the arrays are our own: arguments are checked, arrays are not scanned */
#define EXAMINE 0    /* 1: main() prints what is likely wrong with the first cloud */
static const char *refused = "the search"; /* what was refused, and the first particle at fault */
static int refused_at;
#define SPH_REFUSED(argument, particle, error) (refused = (argument), refused_at = (int)(particle))
#include "sph.h"

enum { DIM = 2, SIDE = 16, LAYERS = 2, WIDE = SIDE + 2 * LAYERS, N_WATER = SIDE * SIDE / 2 };
enum { N = N_WATER + WIDE * WIDE - SIDE * SIDE, NEIGHBOURS = 36 };
#define KERNEL SPH_CUBIC_SPLINE /* a constant: the compiler then folds kernel and dimension away */

/* a particle for each light: lengths are in lights; density, gravity, the weight of a particle are 1 */
static const float h = 1.0f, radius = 2.0f, dt = 0.007f, m = 1.0f;
static const sph_tait water = {.rho0 = 1.0f, .c = 30.0f, .gamma = 1.0f};
static float x[N], y[N], vx[N], vy[N], ax[N], ay[N];
static float rho[N], p[N], p_wall[N], wall_vx[N], wall_vy[N], is_water[N];
/* of the search and its lists: sph_search_size(2, N, N * NEIGHBOURS), which setup() compares */
static unsigned char memory[(N + 18) * 24 + 8 + (N + 1 + N * NEIGHBOURS) * 4];
static uint16_t light[SIDE]; /* a row of lights each, bit 0 left */

/* 0, or a negative sph_error */
static int setup(void)
{
    int n = 0;
    for (int j = 0; j < SIDE / 2; j++)
        for (int i = 0; i < SIDE; i++, n++) {
            x[n] = (float)i + 0.5f;
            y[n] = (float)j + 0.5f;
            is_water[n] = 1;
        }
    for (int j = -LAYERS; j < SIDE + LAYERS; j++)
        for (int i = -LAYERS; i < SIDE + LAYERS; i++) {
            if (i >= 0 && i < SIDE && j >= 0 && j < SIDE) continue;
            x[n] = (float)i + 0.5f;
            y[n++] = (float)j + 0.5f;
        }
    for (int i = 0; i < N; i++) rho[i] = 1;
    return n == N && sph_search_size(DIM, N, N * NEIGHBOURS) <= sizeof memory ? 0 : SPH_ERROR_CAPACITY;
}
/* Who is near whom. 0, or a negative sph_error */
static int search(sph_cloud *all)
{
    const sph_scalars R = sph_scalars_same(&radius), H = sph_scalars_same(&h), none = sph_scalars_none();
    const sph_points points = sph_points_separate(N, x, y, 0);
    sph_neighbors found;
    const int error = sph_search(DIM, points, R, SPH_GATHER, memory, sizeof memory, &found);
    if (!error) *all = sph_cloud_checked(DIM, sph_cloud_of(points, found.list, H, none)); /* for 3 sweeps */
    return error;
}

/* One step under the gravity (gx, gy). 0, or a negative sph_error */
static int step(float gx, float gy)
{
    const sph_scalars mass = sph_scalars_same(&m), density = sph_scalars_array(rho);
    const sph_scalars pressure = sph_scalars_array(p), c = {&water.c, 0};
    const sph_vectors v = sph_vectors_separate(vx, vy, 0); /* walls: 0 */
    const sph_fluid fluid = {mass, density, pressure, c, v, SPH_VISCOSITY_MONAGHAN, 0.8f, 0, 0.1f};
    const sph_wall wall = {sph_scalars_array(is_water), density, pressure, v, v, .gravity = {gx, gy, 0}};
    const sph_wall_out on_wall = {.p = p_wall, .v = sph_vector_out_separate(wall_vx, wall_vy, 0)};
    const sph_fluid_out force = {.acceleration = sph_vector_out_separate(ax, ay, 0)};
    sph_cloud all;
    int error;
    for (int i = 0; i < N_WATER; i++) { /* kick and drift */
        x[i] += dt * (vx[i] += dt * (ax[i] + gx));
        y[i] += dt * (vy[i] += dt * (ay[i] + gy));
    }
    error = search(&all);
    if (error) return error;
    const sph_cloud wet = sph_cloud_range(all, 0, N_WATER), walls = sph_cloud_range(all, N_WATER, N);
    error = sph_density_summation(KERNEL, DIM, wet, mass, sph_scalar_out_array(rho, 0)); /* does not drift */
    for (int i = 0; i < N_WATER; i++) {
        rho[i] = fmaxf(rho[i], 1); /* the surface lets go: no tension */
        p[i] = sph_pressure_tait(rho[i], water);
    }
    if (!error) error = sph_wall_adami(KERNEL, DIM, walls, wall, on_wall);
    if (error < 0) return error; /* above 0: wall particles without water in reach */
    for (int i = N_WATER; i < N; i++) {
        p[i] = p_wall[i] > 0 ? p_wall[i] : 0;
        rho[i] = sph_density_tait(p[i], water);
    }
    return sph_fluid_rates_monaghan(KERNEL, DIM, wet, fluid, force);
}
/* What the firmware calls: some steps, then the lights. */
static int loop(float gx, float gy)
{
    int i, error = 0;
    for (i = 0; i < 10 && !error; i++) error = step(gx, gy);
    for (i = 0; i < SIDE; i++) light[i] = 0;
    for (i = 0; i < N_WATER; i++)
        if (x[i] >= 0 && x[i] < SIDE && y[i] >= 0 && y[i] < SIDE)
            light[(int)y[i]] |= (uint16_t)(1u << (int)x[i]);
    return error;
}
static const float down[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}; /* turned by 90 degrees, thrice */
enum { CALLS = 250 }; /* of loop(), until the water is at rest */

#if !__STDC_HOSTED__
int main(void)
{
    int error = setup();
    for (int turn = 0; !error; turn = (turn + 1) % 4)
        for (int call = 0; call < CALLS && !error; call++) /* and light[] to the board */
            error = loop(down[turn][0], down[turn][1]);
    return error;
}
#else
#include <locale.h>
#include <stdio.h>
#include <string.h>
/* at rest: does the water lie on the floor, 8 deep, and carry its weight? */
static int check(const float *g)
{
    double height = 0, speed = 0, weight = 0, floor_count = 0;
    int i, lost = 0;
    for (i = 0; i < N_WATER; i++) {
        const double above = 8 - (double)(g[0] * (x[i] - 8) + g[1] * (y[i] - 8)); /* the floor */
        height += above / N_WATER;
        speed += (double)sqrtf(vx[i] * vx[i] + vy[i] * vy[i]) / N_WATER;
        if (above < 1) weight += (double)p[i], floor_count++;
        lost += !(x[i] > 0 && x[i] < SIDE && y[i] > 0 && y[i] < SIDE);
    }
    if (lost) return fprintf(stderr, "FAILED: %d particles have left the box\n", lost);
    if (!(fabs(height - 4) < 0.4)) return fprintf(stderr, "FAILED: the height is %g, not 4\n", height);
    if (!(speed < 0.3)) return fprintf(stderr, "FAILED: the water still moves with a speed of %g\n", speed);
    if (!(fabs(weight / floor_count - 7.5) < 0.8))
        return fprintf(stderr, "FAILED: the pressure is not 7.5: %g\n", weight / floor_count);
    return 0;
}
static void examine(void) /* with both sides of pairs: forces are symmetric */
{
    sph_findings f = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud cloud;
    if (search(&cloud)) return;
    sph_cloud_examine(KERNEL, DIM, cloud, 1, 0, &f);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (f.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)f.at[i].particle,
                    (int)f.at[i].neighbour, (double)f.at[i].ratio, sph_finding_text(i));
}
static int run(int csv, int shows)
{
    static const int shown[2] = {40, CALLS - 1}; /* of each turn: on the way, and at rest */
    char picture[2][SIDE][4 * (SIDE + 3)];
    int i, j, k, error = setup(), failed = 0;
    if (EXAMINE && !error) examine();
    if (csv) puts("turn,x,y,p");
    memset(picture, ' ', sizeof picture);
    for (int turn = 0; turn < 4 && !error; turn++) {
        for (int call = 0; call < CALLS && !error; call++) {
            error = loop(down[turn][0], down[turn][1]);
            for (k = 0; k < 2; k++)
                for (j = 0; j < SIDE && call == shown[k]; j++)
                    for (i = 0; i < SIDE; i++)
                        picture[k][SIDE - 1 - j][turn * (SIDE + 3) + i] = light[j] >> i & 1 ? '#' : '.';
        }
        failed |= check(down[turn]) != 0;
        for (i = 0; i < N_WATER && csv; i++)
            printf("%d,%g,%g,%g\n", turn, (double)x[i], (double)y[i], (double)p[i]);
    }
    if (error) fprintf(stderr, "%s: %s, first at particle %d\n", refused, sph_status_text(error), refused_at);
    for (k = 0; k < 2 && shows; k++) {
        printf(k ? "at rest:\n" : "gravity down, to the right, up, to the left; on the way:\n");
        for (j = 0; j < SIDE; j++) printf("%.*s\n", 4 * (SIDE + 3) - 3, picture[k][j]);
    }
    if (shows) printf("%d particles of water, %d of wall, ", (int)N_WATER, (int)(N - N_WATER));
    if (shows) printf("%d bytes of static memory\n", (int)(sizeof x * 12 + sizeof memory + sizeof light));
    return failed || error;
}
static int save(const char *name) /* as NAME.part, renamed when it is whole; a device is written as it is */
{
    char part[4096];
    snprintf(part, sizeof part, "%.4000s%s", name, strncmp(name, "/dev/", 5) ? ".part" : "");
    if (!setlocale(LC_NUMERIC, "C") || !freopen(part, "wb", stdout)) return perror(name), 2; /* no "1,5" */
    const int failed = run(1, 0);
    if (!ferror(stdout) && !fclose(stdout) && (!rename(part, name) || (!remove(name) && !rename(part, name))))
        return failed;
    return perror(name), strcmp(part, name) && remove(part), 2;
}
int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return run(0, 0) || puts("ok") < 0;
    if (argc == 1) return run(0, 1);
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "embedded_loop: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("embedded_loop [-o FILE.csv | -t]   "
                "show the lights, write the particles for a plot, or test them") < 0;
}
#endif
