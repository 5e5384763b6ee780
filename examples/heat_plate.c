/* SPDX-License-Identifier: MIT
 *
 * heat_plate.c - heat spreads through a square plate from its hot edge.
 *
 *     cc -O2 -I. -o heat_plate examples/heat_plate.c -lm
 *     ./heat_plate -o plate.csv
 *
 * dT/dt = div(m grad T) on particles that are not in order, by M-SPH (Lukyanov & Vuik 2020). Nothing moves, so the operator is made once, as rows of weights:
 * each step then is one pass over them, sph_rows_apply, and the longest stable step comes from the rows, too. The left edge has T = 1, the others T = 0.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sph.h"

enum { DIM = 2, SIDE = 33, N = SIDE * SIDE, NEIGHBOURS = 40 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double pi = 3.14159265358979324, conductivity = 1;
static const double dx = 1.0 / (SIDE - 1), h = 1.3 / (SIDE - 1), V = 1.0 / ((SIDE - 1) * (SIDE - 1));
static double x[N], y[N], temperature[N], rate[N], row[N * NEIGHBOURS], dt, t;
static sph_index start[N + 1], list_index[N * NEIGHBOURS];

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    if (failed == 0) return;
    fprintf(stderr, "heat_plate: %s\n", failed < 0 ? sph_status_text((int)failed) : "particles without an answer");
    exit(1);
}

static sph_cloud cloud(void)
{
    const sph_list list = {start, list_index};
    return sph_cloud_of(sph_points_separate(N, x, y, NULL), list, sph_scalars_same(&h), sph_scalars_same(&V));
}

static int on_edge(int i) { return i % SIDE == 0 || i % SIDE == SIDE - 1 || i / SIDE == 0 || i / SIDE == SIDE - 1; }

/* a square lattice with its edge on that of the plate; inside, particles are displaced at random by up to a tenth of the spacing */
static void fill(void)
{
    uint32_t state = 3;
    int i, c;
    for (i = 0; i < N; i++) {
        double jitter[2];
        for (c = 0; c < 2; c++) jitter[c] = 0.2 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (i % SIDE + (on_edge(i) ? 0 : jitter[0])) * dx;
        y[i] = (i / SIDE + (on_edge(i) ? 0 : jitter[1])) * dx;
    }
}

static void make_rows(void)
{
    const sph_points points = cloud().points;
    const double radius = sph_kernel_support(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius);
    const size_t size = sph_grid_workspace(DIM, N);
    void *const work = malloc(size);
    const sph_elliptic_options options = sph_elliptic_defaults();
    sph_grid grid;
    int64_t pairs;
    need(sph_grid_build(DIM, points, radius, work, size, &grid));
    need(sph_grid_lists(DIM, &grid, points, SPH_GATHER, R, R, 0, start, list_index, N * NEIGHBOURS, &pairs));
    need(sph_elliptic_rows_msph(KERNEL, DIM, cloud(), sph_scalars_same(&conductivity), options,
                                (sph_row_out){.row = row}));
    need(sph_rows_time_step(cloud(), row, &dt));
    dt *= 0.5; /* the longest stable step, and half of it so that nothing ever gets hotter than its neighbourhood */
    free(work);
}

static void step(void) /* explicit Euler; the particles on the edge keep their temperature */
{
    int i;
    need(sph_rows_apply(cloud(), row, NULL, sph_scalars_array(temperature), rate));
    for (i = 0; i < N; i++)
        if (!on_edge(i)) temperature[i] += dt * rate[i];
    t += dt;
}

static void heat_left_edge(void)
{
    int i;
    for (i = 0; i < N; i++) temperature[i] = i % SIDE == 0 ? 1 : 0;
    t = 0;
}

/* a character for each particle of every other line, a tenth of T from one to the next */
static void draw(void)
{
    int line, i;
    printf("t = %.4f\n", t);
    for (line = SIDE - 1; line >= 0; line -= 2) {
        putchar('|');
        for (i = line * SIDE; i < (line + 1) * SIDE; i++) putchar(" .:-=+*#%@"[(int)(9.99 * temperature[i])]);
        printf("|\n");
    }
}

static int failed;
static void check(const char *what, double value, double expected, double tolerance)
{
    if (fabs(value - expected) < tolerance) return;
    printf("FAILED: %s is %g, not %g\n", what, value, expected);
    failed = 1;
}
static int test(void)
{
    const int centre = SIDE / 2 * SIDE + SIDE / 2;
    double least = 1, most = 0, first;
    int i;
    /* all edges cold: sin(pi x) sin(pi y) keeps its shape and decays as exp(-2 pi^2 m t) */
    for (i = 0; i < N; i++) temperature[i] = on_edge(i) ? 0 : sin(pi * x[i]) * sin(pi * y[i]);
    first = temperature[centre];
    while (t < 0.1) step();
    check("the rate of decay", log(first / temperature[centre]) / t / (2 * pi * pi * conductivity), 1, 0.02);
    /* left edge hot, in the end: four such plates, one turned to each side, add up to T = 1, so a quarter of it in the centre */
    heat_left_edge();
    while (t < 0.5) {
        step();
        for (i = 0; i < N; i++) {
            least = fmin(least, temperature[i]);
            most = fmax(most, temperature[i]);
        }
    }
    check("the temperature in the centre", temperature[centre], 0.25, 0.005);
    check("the lowest temperature", least, 0, 1e-12);
    check("the highest temperature", most, 1, 1e-12);
    if (!failed) printf("ok\n");
    return failed;
}

int main(int argc, char **argv)
{
    static const double times[] = {0.002, 0.02, 0.2};
    const int tests = argc == 2 && strcmp(argv[1], "-t") == 0, writes = argc == 3 && strcmp(argv[1], "-o") == 0;
    char part[4096]; /* renamed when it is whole, so that no half of a file is left; a device is written as it is */
    FILE *file = stdout;
    int k, i;
    if (argc > 1 && !tests && !writes) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "heat_plate: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "heat_plate [-o FILE.csv | -t]   draw the plate at three times, write them for a plot, or test them\n");
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
    fill();
    make_rows();
    if (tests) return test();
    heat_left_edge();
    if (writes) fprintf(file, "t,x,y,temperature\n");
    for (k = 0; k < 3; k++) {
        while (t < times[k]) step();
        for (i = 0; i < N && writes; i++) fprintf(file, "%g,%.5g,%.5g,%.5g\n", times[k], x[i], y[i], temperature[i]);
        if (!writes) draw();
    }
    if (!writes) printf("in the centre: %.4f; 0.25 in the end\n", temperature[SIDE / 2 * SIDE + SIDE / 2]);
    if (!writes || (!ferror(file) && fclose(file) == 0 && (rename(part, argv[2]) == 0 || (remove(argv[2]) == 0 && rename(part, argv[2]) == 0)))) return 0;
    perror(argv[2]);
    if (strcmp(part, argv[2]) != 0) remove(part);
    return 2;
}
