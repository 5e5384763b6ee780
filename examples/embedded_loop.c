/* SPDX-License-Identifier: MIT
 *
 * embedded_loop.c - water in a box of 16 x 16 lights that runs to wherever is down: a loop for a microcontroller.
 *
 *     cc -O2 -I. -o embedded_loop examples/embedded_loop.c -lm
 *     ./embedded_loop
 *
 * Single precision, static buffers of known size, no heap, no stdio in the loop, one answer for the caller: what a firmware needs. loop() takes the reading of an accelerometer
 * and sets the lights; main() stands for the board: it turns the box by 90 degrees and, where there is a terminal, prints.
 */
#define SPH_SINGLE 1 /* sph_real is float, everywhere */
#define SPH_CHECK 0  /* the arrays are our own: arguments are checked, arrays are not scanned */
#include "sph.h"

enum { DIM = 2, SIDE = 16, LAYERS = 2, N_WATER = SIDE * SIDE / 2, N = N_WATER + (SIDE + 2 * LAYERS) * (SIDE + 2 * LAYERS) - SIDE * SIDE, NEIGHBOURS = 36 };
#define KERNEL SPH_CUBIC_SPLINE /* a constant: the compiler then folds kernel and dimension away */

/* a particle for each light: lengths are in lights, the density is 1, gravity and so the weight of a particle, too */
static const float h = 1.0f, radius = 2.0f, dt = 0.007f, m = 1.0f;
static const sph_tait water = {.rho0 = 1.0f, .c = 30.0f, .gamma = 1.0f};
static float x[N], y[N], vx[N], vy[N], ax[N], ay[N], rho[N], p[N], p_wall[N], wall_vx[N], wall_vy[N], is_water[N];
static sph_index start[N + 1], list_index[N * NEIGHBOURS];
static double work[(N + 18) * 20 / 8 + 1]; /* of the search: sph_grid_workspace(2, N), which setup() compares */
static uint16_t light[SIDE];               /* a row of lights each, bit 0 left */

/* 0, or a negative sph_error */
static int setup(void)
{
    int i, j, n = 0;
    for (j = 0; j < SIDE / 2; j++)
        for (i = 0; i < SIDE; i++, n++) {
            x[n] = (float)i + 0.5f;
            y[n] = (float)j + 0.5f;
            is_water[n] = 1;
        }
    for (j = -LAYERS; j < SIDE + LAYERS; j++)
        for (i = -LAYERS; i < SIDE + LAYERS; i++) {
            if (i >= 0 && i < SIDE && j >= 0 && j < SIDE) continue;
            x[n] = (float)i + 0.5f;
            y[n++] = (float)j + 0.5f;
        }
    for (i = 0; i < N; i++) rho[i] = 1;
    return n == N && sph_grid_workspace(DIM, N) <= sizeof work ? 0 : SPH_ERROR_CAPACITY;
}

/* One step under the gravity (gx, gy). 0, or a negative sph_error */
static int step(float gx, float gy)
{
    const sph_points points = sph_points_separate(N, x, y, 0);
    const sph_scalars R = sph_scalars_same(&radius), H = sph_scalars_same(&h), mass = sph_scalars_same(&m);
    const sph_scalars density = sph_scalars_array(rho), pressure = sph_scalars_array(p), c = {&water.c, 0};
    const sph_vectors v = sph_vectors_separate(vx, vy, 0); /* walls: 0 */
    const sph_cloud all = sph_cloud_of(points, (sph_list){start, list_index}, H, sph_scalars_none());
    const sph_cloud wet = sph_cloud_range(all, 0, N_WATER), walls = sph_cloud_range(all, N_WATER, N);
    const sph_fluid fluid = {mass, density, pressure, c, v, SPH_VISCOSITY_MONAGHAN, 0.8f, 0, 0.1f};
    const sph_wall wall = {.share = sph_scalars_array(is_water), .rho = density, .p = pressure, .v = v,
                           .velocity = v, .gravity = {gx, gy, 0}};
    const sph_wall_out on_wall = {p_wall, sph_vector_out_separate(wall_vx, wall_vy, 0), 0};
    sph_grid grid;
    int64_t pairs;
    int i, error;
    for (i = 0; i < N_WATER; i++) { /* kick and drift */
        vx[i] += dt * (ax[i] + gx);
        vy[i] += dt * (ay[i] + gy);
        x[i] += dt * vx[i];
        y[i] += dt * vy[i];
    }
    error = sph_grid_build(DIM, points, radius, work, sizeof work, &grid);
    if (!error) error = sph_grid_lists(DIM, &grid, points, SPH_GATHER, R, R, 0, start, list_index, N * NEIGHBOURS, &pairs);
    if (!error) error = sph_density_summation(KERNEL, DIM, wet, mass, rho); /* does not drift in time */
    for (i = 0; i < N_WATER; i++) {
        rho[i] = fmaxf(rho[i], 1); /* the surface lets go: no tension */
        p[i] = sph_pressure_tait(rho[i], water);
    }
    if (!error) error = sph_wall_adami(KERNEL, DIM, walls, wall, on_wall);
    if (error < 0) return error; /* above 0: wall particles without water in reach */
    for (i = N_WATER; i < N; i++) {
        p[i] = p_wall[i] > 0 ? p_wall[i] : 0;
        rho[i] = sph_density_tait(p[i], water);
    }
    return sph_fluid_rates_monaghan(KERNEL, DIM, wet, fluid, sph_vector_out_separate(ax, ay, 0), 0, 0);
}

/* What the firmware calls: some steps, then the lights. */
static int loop(float gx, float gy)
{
    int i, error = 0;
    for (i = 0; i < 10 && !error; i++) error = step(gx, gy);
    for (i = 0; i < SIDE; i++) light[i] = 0;
    for (i = 0; i < N_WATER; i++)
        if (x[i] >= 0 && x[i] < SIDE && y[i] >= 0 && y[i] < SIDE) light[(int)y[i]] |= (uint16_t)(1u << (int)x[i]);
    return error;
}

static const float down[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}; /* the box is turned by 90 degrees, three times */
enum { CALLS = 250 };                                               /* of loop(), until the water is at rest */

#if !__STDC_HOSTED__
int main(void)
{
    int turn, call, error = setup();
    for (turn = 0; !error; turn = (turn + 1) % 4)
        for (call = 0; call < CALLS && !error; call++) error = loop(down[turn][0], down[turn][1]); /* and light[] to the board */
    return error;
}
#else
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
        if (above < 1) weight += (double)p[i];
        if (above < 1) floor_count++;
        lost += !(x[i] > 0 && x[i] < SIDE && y[i] > 0 && y[i] < SIDE);
    }
    weight /= floor_count;
    if (lost) return printf("FAILED: %d particles have left the box\n", lost);
    if (!(fabs(height - 4) < 0.4)) return printf("FAILED: the middle of the water is %g above the floor, not 4\n", height);
    if (!(speed < 0.3)) return printf("FAILED: the water still moves with a speed of %g\n", speed);
    if (!(fabs(weight - 7.5) < 0.8)) return printf("FAILED: the pressure on the floor is %g, not 7.5\n", weight);
    return 0;
}

int main(int argc, char **argv)
{
    const int tests = argc == 2 && strcmp(argv[1], "-t") == 0, writes = argc == 3 && strcmp(argv[1], "-o") == 0;
    static const int shown[2] = {40, CALLS - 1}; /* of each turn: on the way, and at rest */
    char picture[2][SIDE][4 * (SIDE + 3)];
    char part[4096]; /* renamed when it is whole, so that no half of a file is left; a device is written as it is */
    FILE *file = stdout;
    int turn, call, i, j, k, error = setup(), failed = 0;
    if (argc > 1 && !tests && !writes) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "embedded_loop: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "embedded_loop [-o FILE.csv | -t]   show the lights, write the particles for a plot, or test them\n");
        return help ? 0 : 2;
    }
    if (writes) {
        snprintf(part, sizeof part, "%.4000s%s", argv[2], strncmp(argv[2], "/dev/", 5) ? ".part" : "");
        file = fopen(part, "w");
    }
    if (!file) {
        perror(argv[2]);
        return 2;
    }
    if (writes) fprintf(file, "turn,x,y,p\n");
    memset(picture, ' ', sizeof picture);
    for (turn = 0; turn < 4 && !error; turn++) {
        for (call = 0; call < CALLS && !error; call++) {
            error = loop(down[turn][0], down[turn][1]);
            for (k = 0; k < 2; k++)
                for (j = 0; j < SIDE && call == shown[k]; j++)
                    for (i = 0; i < SIDE; i++) picture[k][SIDE - 1 - j][turn * (SIDE + 3) + i] = light[j] >> i & 1 ? '#' : '.';
        }
        failed |= check(down[turn]) != 0;
        for (i = 0; i < N_WATER && writes; i++) fprintf(file, "%d,%g,%g,%g\n", turn, (double)x[i], (double)y[i], (double)p[i]);
    }
    if (error) printf("FAILED: %s\n", sph_status_text(error));
    if (tests && !failed && !error) printf("ok\n");
    if (writes && (ferror(file) || fclose(file) || (rename(part, argv[2]) && (remove(argv[2]) || rename(part, argv[2]))))) {
        perror(argv[2]);
        if (strcmp(part, argv[2]) != 0) remove(part);
        return 2;
    }
    if (tests || writes) return failed || error;
    for (k = 0; k < 2; k++) {
        printf(k ? "at rest:\n" : "gravity down, to the right, up, to the left; on the way:\n");
        for (j = 0; j < SIDE; j++) printf("%.*s\n", 4 * (SIDE + 3) - 3, picture[k][j]);
    }
    printf("%d particles of water, %d of wall, %d bytes of static memory\n", (int)N_WATER, (int)(N - N_WATER),
           (int)(sizeof x * 12 + sizeof start + sizeof list_index + sizeof work + sizeof light));
    return 0;
}
#endif
