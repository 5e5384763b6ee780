/* SPDX-License-Identifier: MIT
 *
 * host_structs.c - a code with its own array of structs: nothing is copied, neither in nor out.
 *
 *     cc -O2 -I. -o host_structs examples/host_structs.c -lm
 *     ./host_structs -o surface.csv
 *
 * Views say where the numbers are: sph_points_strided and sph_scalars_strided take a pointer to the member of the first struct, and the way to the next one, counted in
 * sph_real. sph_derivatives_icspm writes its results into members, too. The task: slope, Laplacian and status at each point of a surveyed hill.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sph.h"

enum { DIM = 2, SIDE = 40, N = SIDE * SIDE, NEIGHBOURS = 60, COLUMNS = 40, ROWS = 20 };
#define KERNEL SPH_WENDLAND_C4 /* a constant: the compiler then folds kernel and dimension away */

/* The host's own type, with things in it that the toolkit knows nothing of. Its size must be a multiple of that of sph_real. */
typedef struct station {
    char name[8];
    sph_real position[2], height, area, slope[2], laplacian;
    int64_t visits;
} station;
enum { STRIDE = sizeof(station) / sizeof(sph_real) };
typedef char size_is_a_multiple[sizeof(station) % sizeof(sph_real) == 0 ? 1 : -1]; /* else this does not compile */
static station hill[N];
static unsigned char status[N];

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    if (failed == 0) return;
    fprintf(stderr, "host_structs: %s\n", failed < 0 ? sph_status_text((int)failed) : "stations without an answer");
    exit(1);
}

/* stations about a tenth of the spacing off a lattice, in random order */
static void survey(double (*height)(double, double))
{
    const double dx = 1.0 / SIDE;
    uint32_t state = 9;
    int i;
    for (i = 0; i < N; i++) {
        const double a = (state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5, b = (state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5;
        station *const s = &hill[i * 7 % N]; /* 7 has no divisor in common with N */
        snprintf(s->name, sizeof s->name, "%c%d", 'A' + i / SIDE % 26, i % SIDE);
        s->position[0] = (i % SIDE + 0.5 + 0.2 * a) * dx;
        s->position[1] = (i / SIDE + 0.5 + 0.2 * b) * dx;
        s->height = height(s->position[0], s->position[1]);
        s->area = dx * dx;
        s->visits++;
    }
}

static void derivatives(void)
{
    const sph_points points = sph_points_strided(N, &hill[0].position[0], &hill[0].position[1], NULL, STRIDE);
    const sph_scalars area = sph_scalars_strided(&hill[0].area, STRIDE), height = sph_scalars_strided(&hill[0].height, STRIDE);
    const double h = sph_kernel_h_over_dx(KERNEL) / SIDE, radius = sph_kernel_support(KERNEL) * h;
    static sph_index start[N + 1], list_index[N * NEIGHBOURS];
    const sph_cloud cloud = sph_cloud_of(points, (sph_list){start, list_index}, sph_scalars_same(&h), area);
    const sph_scalars R = sph_scalars_same(&radius);
    void *const work = malloc(sph_grid_workspace(DIM, N));
    sph_derivative_out out = {0};
    sph_grid grid;
    int64_t pairs;
    need(sph_grid_build(DIM, points, radius, work, sph_grid_workspace(DIM, N), &grid));
    need(sph_grid_lists(DIM, &grid, points, SPH_GATHER, R, R, 0, start, list_index, N * NEIGHBOURS, &pairs));
    free(work);
    out.gx = &hill[0].slope[0]; /* what is not asked for stays null */
    out.gy = &hill[0].slope[1];
    out.laplacian = &hill[0].laplacian;
    out.stride = STRIDE;
    out.status = status;
    /* exact for quadratic fields, at the edge, too; where that is ill-conditioned weighted least squares take over (status: SPH_FELL_BACK) */
    if (sph_derivatives_icspm(KERNEL, DIM, cloud, height, 1e-3, 1, out) < 0) need(-1);
}

static double parabola(double x, double y) { return 1 + 2 * x - y + 3 * x * x + 4 * x * y - 2 * y * y; }
static double summit(double x, double y)
{
    return exp(-8 * ((x - 0.4) * (x - 0.4) + (y - 0.5) * (y - 0.5))) + 0.5 * exp(-15 * ((x - 0.8) * (x - 0.8) + (y - 0.7) * (y - 0.7)));
}
static double summit_laplacian(double x, double y)
{
    const double a = (x - 0.4) * (x - 0.4) + (y - 0.5) * (y - 0.5), b = (x - 0.8) * (x - 0.8) + (y - 0.7) * (y - 0.7);
    return (256 * a - 32) * exp(-8 * a) + 0.5 * (900 * b - 60) * exp(-15 * b);
}
static double error(void) /* root mean square, of the Laplacian of summit */
{
    double sum = 0;
    int i;
    for (i = 0; i < N; i++) sum += pow(hill[i].laplacian - summit_laplacian(hill[i].position[0], hill[i].position[1]), 2);
    return sqrt(sum / N);
}

/* a map: where water runs, as the direction of the steepest descent; o where it is flat; # where the surface bends down */
static void draw(void)
{
    char map[ROWS][COLUMNS + 1];
    int i, fell_back = 0;
    memset(map, ' ', sizeof map);
    for (i = 0; i < N; i++) {
        const station *const s = &hill[i];
        const double gx = -s->slope[0], gy = -s->slope[1];
        char c = fabs(gx) > fabs(gy) ? (gx > 0 ? '>' : '<') : gy > 0 ? '^' : 'v';
        if (gx * gx + gy * gy < 0.05) c = 'o';
        if (s->laplacian < -20) c = '#';
        map[(int)((1 - s->position[1]) * ROWS)][(int)(s->position[0] * COLUMNS)] = c;
        fell_back += status[i] == SPH_FELL_BACK;
    }
    for (i = 0; i < ROWS; i++) printf("%.*s\n", COLUMNS, map[i]);
    printf("< ^ > v: where water runs; o: flat; #: Laplacian below -20. Fallbacks: %d of %d\n", fell_back, (int)N);
    for (i = 0; i < 3; i++)
        printf("%-4s height %6.3f, slope (%6.3f, %6.3f), Laplacian %7.3f\n", hill[i].name, hill[i].height, hill[i].slope[0], hill[i].slope[1],
               hill[i].laplacian);
    printf("error of the Laplacian (root mean square): %.3f\n", error());
}

static int test(void)
{
    double worst = 0;
    int i, damaged = 0, failed = 0;
    survey(parabola);
    derivatives();
    for (i = 0; i < N; i++) {
        const double x = hill[i].position[0], y = hill[i].position[1];
        worst = fmax(worst, fabs(hill[i].slope[0] - (2 + 6 * x + 4 * y)) + fabs(hill[i].slope[1] - (-1 + 4 * x - 4 * y)) + fabs(hill[i].laplacian - 2));
        if (hill[i].visits != 1 || hill[i].name[0] < 'A' || hill[i].name[0] > 'Z' || fabs(hill[i].area * N - 1) > 1e-12) damaged++;
    }
    if (damaged) failed = printf("FAILED: %d stations have lost something\n", damaged);
    if (!(worst < 1e-8)) failed = printf("FAILED: derivatives of a parabola are off by %g\n", worst);
    survey(summit);
    derivatives();
    if (!(error() < 0.8)) failed = printf("FAILED: the Laplacian of the hill is off by %g\n", error());
    if (!failed) printf("ok\n");
    return failed != 0;
}

static int write_csv(const char *name)
{
    char part[4096]; /* renamed when it is whole, so that no half of a file is left; a device is written as it is */
    FILE *file;
    int i;
    snprintf(part, sizeof part, "%.4000s%s", name, strncmp(name, "/dev/", 5) ? ".part" : "");
    file = fopen(part, "w");
    if (!file) {
        perror(name);
        return 2;
    }
    fprintf(file, "x,y,height,slope_x,slope_y,laplacian,status\n");
    for (i = 0; i < N; i++)
        fprintf(file, "%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%d\n", hill[i].position[0], hill[i].position[1], hill[i].height, hill[i].slope[0], hill[i].slope[1],
                hill[i].laplacian, status[i]);
    if (!ferror(file) && fclose(file) == 0 && (rename(part, name) == 0 || (remove(name) == 0 && rename(part, name) == 0))) return 0;
    perror(name);
    if (strcmp(part, name) != 0) remove(part);
    return 2;
}

int main(int argc, char **argv)
{
    const int writes = argc == 3 && strcmp(argv[1], "-o") == 0;
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc > 1 && !writes) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "host_structs: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "host_structs [-o FILE.csv | -t]   draw where water runs on a hill, write it for a plot, or test the derivatives\n");
        return help ? 0 : 2;
    }
    survey(summit);
    derivatives();
    if (writes) return write_csv(argv[2]);
    draw();
    return 0;
}
