/* SPDX-License-Identifier: MIT
 *
 * probes.c - velocity, vorticity and pressure of a flow at points that are no particles, and gauges at a wall.
 *
 *     cc -O2 -I. -o probes examples/probes.c -lm
 *     ./probes                     the vorticity of a vortex in a tank, and the pressure along its floor
 *
 * The particles are one moment of a simulation: a vortex in a square tank with gravity, whose velocity and
 * pressure have a formula to compare with. Probes lie on a grid that has nothing to do with the particles; the
 * gauges lie on the floor, half a spacing below the lowest particles. Moving least squares give a value and a
 * gradient at each, exactly where the field is linear. They come as rows: computed once, used for each field.
 */
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the particles */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, SIDE = 40, N = SIDE * SIDE, COLUMNS = 60, ROWS = 24, MAP = COLUMNS * ROWS, GAUGES = 41, PROBES = MAP + GAUGES };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double pi = 3.14159265358979323846, g = 3;
static double dx, h, volume, x[N], y[N], u[N], v[N], p[N]; /* the particles; the density is 1 */
static double at_x[PROBES], at_y[PROBES], speed[PROBES], vorticity[PROBES], pressure[PROBES], shepard[PROBES]; /* the probes */

static double exact_u(double a, double b) { return sin(pi * a) * cos(pi * b); }
static double exact_v(double a, double b) { return -cos(pi * a) * sin(pi * b); }
static double exact_vorticity(double a, double b) { return 2 * pi * sin(pi * a) * sin(pi * b); }
static double exact_p(double a, double b) { return 0.25 * (cos(2 * pi * a) + cos(2 * pi * b)) + g * (1 - b); }

static void need(sph_index answer) /* what a sweep returns: below 0 an error */
{
    if (answer < 0) fprintf(stderr, "probes: %s\n", sph_status_text((int)answer)), exit(1);
}
static void examine(sph_cloud given)
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 0, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}

static double shake(void) /* -0.2 ... 0.2, in any order */
{
    static unsigned state = 1;
    state = (state * 1664525u + 1013904223u) & 0xffffffffu;
    return 0.4 * ((state >> 8) / 16777216.0 - 0.5);
}
static void fill(void)
{
    dx = 1.0 / SIDE, h = 1.6 * dx, volume = dx * dx;
    for (int i = 0; i < N; i++) {
        x[i] = (i % SIDE + 0.5 + shake()) * dx, y[i] = (i / SIDE + 0.5 + shake()) * dx;
        u[i] = exact_u(x[i], y[i]), v[i] = exact_v(x[i], y[i]), p[i] = exact_p(x[i], y[i]);
    }
    for (int i = 0; i < MAP; i++) at_x[i] = (i % COLUMNS + 0.5) / COLUMNS, at_y[i] = 1 - (i / COLUMNS + 0.5) / ROWS;
    for (int i = 0; i < GAUGES; i++) at_x[MAP + i] = (double)i / (GAUGES - 1), at_y[MAP + i] = 0;
}

static void measure(void)
{
    static sph_index start[PROBES + 1];
    static unsigned char status[PROBES];
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius), H = sph_scalars_same(&h), V = sph_scalars_same(&volume);
    const sph_points particles = sph_points_separate(N, x, y, NULL), points = sph_points_separate(PROBES, at_x, at_y, NULL);
    const sph_sources sources = {particles, V};
    const sph_interpolation_options options = {.conditioning_min = 1e-3};
    const sph_query query = sph_query_of(points, SPH_GATHER, R, SPH_LIST_FOREIGN); /* the probes are no particles */
    sph_interpolation_rows_out rows = {.status = status};
    sph_neighbors found;
    void *memory = NULL;
    size_t size = 0;
    sph_index answer, *index;
    int64_t pairs;
    while ((answer = sph_search(DIM, particles, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, N, found.pairs));
    need(answer);
    if (EXAMINE) examine(sph_cloud_of(particles, found.list, H, V));
    /* the lists of the probes, by the grid of the particles */
    need(sph_grid_count(DIM, &found.grid, query, start, &pairs));
    index = malloc((size_t)pairs * sizeof *index);
    rows.value = malloc((size_t)pairs * sizeof *rows.value);
    rows.x = malloc((size_t)pairs * sizeof *rows.x);
    rows.y = malloc((size_t)pairs * sizeof *rows.y);
    if (!index || !rows.value || !rows.x || !rows.y) need(SPH_ERROR_CAPACITY);
    need(sph_grid_lists(DIM, &found.grid, query, start, index, pairs, &pairs));
    const sph_list list = {start, index};
    const sph_cloud probes = sph_cloud_of(points, list, H, sph_scalars_none());
    need(answer = sph_interpolate_rows_mls(KERNEL, DIM, probes, sources, options, rows));
    if (answer > 0) fprintf(stderr, "probes: %d have too few neighbours for a linear fit\n", (int)answer);
    for (int i = 0; i < PROBES; i++) {
        double a = 0, b = 0, weight = 0, mean = 0;
        pressure[i] = vorticity[i] = 0;
        for (sph_index q = start[i]; q < start[i + 1]; q++) {
            const int j = index[q];
            const double w = sph_kernel_w(KERNEL, DIM, hypot(x[j] - at_x[i], y[j] - at_y[i]), h);
            a += rows.value[q] * u[j], b += rows.value[q] * v[j];
            vorticity[i] += rows.x[q] * v[j] - rows.y[q] * u[j];
            pressure[i] += rows.value[q] * p[j];
            weight += w, mean += w * p[j];
        }
        speed[i] = hypot(a, b);
        shepard[i] = mean / weight; /* what a mean over the neighbours would say */
    }
    free(index), free(rows.value), free(rows.x), free(rows.y), free(memory);
}
typedef struct errors {
    double speed, vorticity, gauge, mean; /* the largest, of the range of each field */
} errors;
static errors worst(void)
{
    errors e = {0};
    for (int i = 0; i < PROBES; i++) {
        const double a = at_x[i], b = at_y[i], p_off = exact_p(a, b);
        e.speed = fmax(e.speed, fabs(speed[i] - hypot(exact_u(a, b), exact_v(a, b))));
        if (i < MAP) e.vorticity = fmax(e.vorticity, fabs(vorticity[i] - exact_vorticity(a, b)) / (2 * pi));
        else e.gauge = fmax(e.gauge, fabs(pressure[i] - p_off) / g), e.mean = fmax(e.mean, fabs(shepard[i] - p_off) / g);
    }
    return e;
}

static void draw(void)
{
    const errors e = worst();
    for (int i = 0; i < MAP; i++) {
        const int level = (int)floor(vorticity[i] / (2 * pi) * 9 + 0.5);
        putchar(" .:-=+*#%@"[level < 0 ? 0 : level > 9 ? 9 : level]);
        if (i % COLUMNS == COLUMNS - 1) putchar('\n');
    }
    printf("gauges on the floor:   x  pressure     exact   mean of the neighbours\n");
    for (int i = MAP; i < PROBES; i += 8) printf("%24.2f  %8.4f  %8.4f  %8.4f\n", at_x[i], pressure[i], exact_p(at_x[i], 0), shepard[i]);
    printf("largest errors: speed %.2f %%, vorticity %.1f %%, gauges %.2f %% (means %.1f %%)\n", 100 * e.speed, 100 * e.vorticity, 100 * e.gauge, 100 * e.mean);
}
static int test(void)
{
    const errors e = worst();
    int failed = 0;
    if (!(e.speed < 0.02)) failed = printf("FAILED: the speed is off by %g\n", e.speed);
    if (!(e.vorticity < 0.1)) failed = printf("FAILED: the vorticity is off by %g\n", e.vorticity);
    if (!(e.gauge < 0.2 * e.mean)) failed = printf("FAILED: the gauges are off by %g, means by %g\n", e.gauge, e.mean);
    return failed ? 1 : puts("ok") < 0;
}
static void run(int csv)
{
    if (!csv) { draw(); return; }
    printf("x,y,speed,vorticity,pressure,exact,mean,gauge\n");
    for (int i = 0; i < PROBES; i++)
        printf("%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%d\n", at_x[i], at_y[i], speed[i], vorticity[i], pressure[i], exact_p(at_x[i], at_y[i]), shepard[i], i >= MAP);
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
    fill(), measure();
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc == 1) return run(0), 0;
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "probes: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("probes [-o FILE.csv | -t]   show what the probes find, write it to a file, or test it") < 0;
}
