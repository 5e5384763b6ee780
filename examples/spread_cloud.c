/* SPDX-License-Identifier: MIT
 *
 * spread_cloud.c - collisions spread a cloud of particles that have clustered.
 *
 *     cc -O2 -I. -o spread_cloud examples/spread_cloud.c -lm
 *     ./spread_cloud -o cloud.csv
 *
 * Clustering is a disease of SPH: particles form pairs and clumps, with voids between them. Let any two that come closer than a collision distance bounce like
 * balls, and they keep apart: sph_collide_sequential, from Korzilius, Schilders & Anthonissen, made energy-stable. Momentum is kept exactly; with a restitution of 1
 * energy, too. Here clumps of four fly about in a periodic box, with collisions and, to compare, without.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sph.h"

enum { DIM = 2, CLUMPS = 12 * 12, N = 4 * CLUMPS, NEIGHBOURS = 60, COLUMNS = 37, ROWS = 18 };
static const double spacing = 1.0 / 24, distance = 0.8 / 24, dt = 0.1 / 24; /* N particles in good order; the speed of most is about 1 */
static double x[N], y[N], vx[N], vy[N], nearest[N], m = 1, inverse_mass = 1, t;
static sph_index start[N + 1], list_index[N * NEIGHBOURS];

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    if (failed == 0) return;
    fprintf(stderr, "spread_cloud: %s\n", failed < 0 ? sph_status_text((int)failed) : "particles without an answer");
    exit(1);
}

static sph_points points(void) { return sph_points_periodic(sph_points_separate(N, x, y, NULL), 1, 1, 0); }
static sph_cloud cloud(void) /* of points with neighbours: nothing here asks for a kernel or volumes */
{
    return sph_cloud_of(points(), (sph_list){start, list_index}, sph_scalars_none(), sph_scalars_none());
}

static uint64_t state;
static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}
static void fill(void) /* four particles in each clump, a tenth of the spacing apart */
{
    int i;
    state = 1;
    for (i = 0; i < N; i++) {
        const int clump = i / 4;
        x[i] = 2 * spacing * (clump % 12 + 0.5) + 0.1 * spacing * (i % 2 - 0.5) + 0.02 * spacing * uniform();
        y[i] = 2 * spacing * (clump / 12 + 0.5) + 0.1 * spacing * (i / 2 % 2 - 0.5) + 0.02 * spacing * uniform();
        vx[i] = 2 * uniform() - 1;
        vy[i] = 2 * uniform() - 1;
    }
    t = 0;
}

static void search(double radius)
{
    static void *work;
    const sph_scalars R = sph_scalars_same(&radius);
    sph_grid grid;
    int64_t pairs;
    if (!work) work = malloc(sph_grid_workspace(DIM, N));
    need(sph_grid_build(DIM, points(), radius, work, sph_grid_workspace(DIM, N), &grid));
    need(sph_grid_lists(DIM, &grid, points(), SPH_GATHER, R, R, 0, start, list_index, N * NEIGHBOURS, &pairs));
}

static void step(int with_collisions)
{
    const sph_scalars inverse = sph_scalars_same(&inverse_mass);
    const sph_collision bounce = {.distance = distance, .restitution = 1, .inverse_mass = inverse};
    int i;
    if (with_collisions) {
        search(distance);
        need(sph_collide_sequential(DIM, cloud(), bounce, sph_vector_out_separate(vx, vy, NULL), NULL));
    }
    for (i = 0; i < N; i++) {
        x[i] += dt * vx[i];
        y[i] += dt * vy[i];
    }
    t += dt;
}

typedef struct order {
    double mean, close;
    sph_conserved sums;
} order;
/* mean distance to the nearest neighbour, and the share of particles that have one within half a spacing */
static order measure(void)
{
    const sph_vectors v = sph_vectors_separate(vx, vy, NULL);
    order o = {0, 0, {0, 0, {0, 0, 0}, {0, 0, 0}}};
    int i;
    search(3.5 * spacing);
    need(sph_nearest_distance(DIM, cloud(), points(), sph_scalar_out_array(nearest, NULL)));
    need(sph_conserved_sums(DIM, cloud(), sph_scalars_same(&m), v, &o.sums));
    for (i = 0; i < N; i++) {
        o.mean += nearest[i] / spacing / N;
        o.close += (nearest[i] < 0.5 * spacing) / (double)N;
    }
    return o;
}

/* particles in a place of the terminal */
static void count(int picture[ROWS][COLUMNS])
{
    int i;
    memset(picture, 0, ROWS * COLUMNS * sizeof(int));
    for (i = 0; i < N; i++) picture[(int)((y[i] - floor(y[i])) * ROWS)][(int)((x[i] - floor(x[i])) * COLUMNS)]++;
}
static void draw(void)
{
    int picture[2][ROWS][COLUMNS], row, column, k;
    order o[3];
    fill();
    o[0] = measure();
    while (t < 1) step(0);
    count(picture[0]);
    o[1] = measure();
    fill();
    while (t < 1) step(1);
    count(picture[1]);
    o[2] = measure();
    printf("%-*s%s\n", COLUMNS + 4, "without collisions", "with");
    for (row = 0; row < ROWS; row++) {
        for (k = 0; k < 2; k++) {
            putchar('|');
            for (column = 0; column < COLUMNS; column++) putchar(" .:+*#@"[picture[k][row][column] > 6 ? 6 : picture[k][row][column]]);
            printf(k ? "|\n" : "|  ");
        }
    }
    for (k = 0; k < 3; k++)
        printf("%-19s nearest %.3f of spacing, %5.1f %% within half; energy %.2f\n",
               k == 0   ? "at first:"
               : k == 1 ? "without collisions:"
                        : "with collisions:",
               o[k].mean, 100 * o[k].close, o[k].sums.kinetic_energy);
}

static int test(void)
{
    order first, random, now;
    double change;
    int failed = 0;
    fill();
    first = measure();
    while (t < 1) step(0);
    random = measure();
    for (fill(), first = measure(); t < 1;) step(1);
    now = measure();
    change = fabs(now.sums.momentum.x - first.sums.momentum.x) + fabs(now.sums.momentum.y - first.sums.momentum.y);
    if (!(now.close < 0.2 * random.close)) failed = printf("FAILED: close pairs: %g of all with collisions, %g without\n", now.close, random.close);
    if (!(now.mean > 1.4 * random.mean)) failed = printf("FAILED: nearest neighbours at %g of the spacing, %g without collisions\n", now.mean, random.mean);
    if (!(fabs(random.mean - 0.5) < 0.05)) failed = printf("FAILED: free particles are random, with neighbours at half a spacing, not at %g\n", random.mean);
    if (!(fabs(now.sums.kinetic_energy / first.sums.kinetic_energy - 1) < 1e-11)) failed = printf("FAILED: energy changes\n");
    if (!(change < 1e-10)) failed = printf("FAILED: momentum changes by %g\n", change);
    if (!failed) printf("ok\n");
    return failed != 0;
}

static int write_csv(const char *name)
{
    char part[4096]; /* renamed when it is whole, so that no half of a file is left; a device is written as it is */
    FILE *file;
    int k, i;
    snprintf(part, sizeof part, "%.4000s%s", name, strncmp(name, "/dev/", 5) ? ".part" : "");
    file = fopen(part, "w");
    if (!file) {
        perror(name);
        return 2;
    }
    fprintf(file, "state,x,y\n");
    for (k = 0; k < 3; k++) { /* at first, without collisions, with */
        fill();
        while (k > 0 && t < 1) step(k == 2);
        for (i = 0; i < N; i++) fprintf(file, "%d,%.5g,%.5g\n", k, x[i] - floor(x[i]), y[i] - floor(y[i]));
    }
    if (!ferror(file) && fclose(file) == 0 && (rename(part, name) == 0 || (remove(name) == 0 && rename(part, name) == 0))) return 0;
    perror(name);
    if (strcmp(part, name) != 0) remove(part);
    return 2;
}

int main(int argc, char **argv)
{
    const int help = argc == 2 && strcmp(argv[1], "-h") == 0;
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return write_csv(argv[2]);
    if (argc > 1) {
        if (!help) fprintf(stderr, "spread_cloud: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "spread_cloud [-o FILE.csv | -t]   draw a cloud without and with collisions, write it for a plot, or test it\n");
        return help ? 0 : 2;
    }
    draw();
    return 0;
}
