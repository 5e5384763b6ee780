/* SPDX-License-Identifier: MIT
 *
 * spread_cloud.c - collisions spread a cloud of particles that have clustered.
 *
 *     cc -O2 -I. -o spread_cloud examples/spread_cloud.c -lm
 *     ./spread_cloud -o cloud.csv
 *
 * Clustering is a disease of SPH: particles form pairs and clumps, with voids between them. Let any two
 * that come closer than a collision distance bounce like balls, and they keep apart:
 * sph_collision_sequential, from Korzilius, Schilders & Anthonissen, made energy-stable. Momentum is kept
 * exactly; with a restitution of 1 energy, too. Here clumps of four fly about in a periodic box, with
 * collisions and, to compare, without.
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, CLUMPS = 12 * 12, N = 4 * CLUMPS, COLUMNS = 37, ROWS = 18 };
/* N particles in good order; the speed of most is about 1 */
static const double spacing = 1.0 / 24, distance = 0.8 / 24, dt = 0.1 / 24;
static double x[N], y[N], vx[N], vy[N], nearest[N], m = 1, inverse_mass = 1, t;
static sph_cloud cloud; /* of points with neighbours: nothing here asks for a kernel or volumes */

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    const char *const why = failed < 0 ? sph_status_text((int)failed) : "particles without an answer";
    if (failed) fprintf(stderr, "spread_cloud: %s\n", why), exit(1);
}
static void examine(sph_cloud c, double radius) /* both sides of pairs, of a kernel that reaches so far */
{
    const double h = sph_kernel_h_from_support(SPH_CUBIC_SPLINE, radius);
    sph_findings f = {0}; /* stays so if there is an error, which the sweeps tell */
    c.h = sph_scalars_same(&h);
    sph_cloud_examine(SPH_CUBIC_SPLINE, DIM, c, 1, 0, &f);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (f.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)f.at[i].particle,
                    (int)f.at[i].neighbour, f.at[i].ratio, sph_finding_text(i));
}

static sph_points points(void) { return sph_points_periodic(sph_points_separate(N, x, y, NULL), 1, 1, 0); }
static uint64_t state;
static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}
static void fill(void) /* four particles in each clump, a tenth of the spacing apart */
{
    state = 1;
    for (int i = 0; i < N; i++) {
        const int clump = i / 4;
        x[i] = 2 * spacing * (clump % 12 + 0.5) + 0.1 * spacing * (i % 2 - 0.5) + 0.02 * spacing * uniform();
        y[i] = 2 * spacing * (clump / 12 + 0.5) + 0.1 * spacing * (i / 2 % 2 - 0.5);
        y[i] += 0.02 * spacing * uniform();
        vx[i] = 2 * uniform() - 1;
        vy[i] = 2 * uniform() - 1;
    }
    t = 0;
}
static void search(double radius)
{
    static void *memory; /* of the search: from step to step */
    static size_t size;
    const sph_scalars R = sph_scalars_same(&radius), none = sph_scalars_none();
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(DIM, points(), R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, N, found.pairs));
    need(answer);
    cloud = sph_cloud_of(points(), found.list, none, none);
    if (EXAMINE && t == 0) examine(cloud, radius);
    cloud = sph_cloud_checked(DIM, cloud);
}
static void step(int with_collisions)
{
    const sph_collision bounce = {distance, .restitution = 1, sph_scalars_same(&inverse_mass)};
    if (with_collisions) {
        search(distance);
        need(sph_collision_sequential(DIM, cloud, bounce, sph_vector_out_separate(vx, vy, NULL), NULL));
    }
    for (int i = 0; i < N; i++) {
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
    search(3.5 * spacing);
    need(sph_nearest_distance(DIM, cloud, points(), sph_scalar_out_array(nearest, NULL)));
    need(sph_conserved_sums(DIM, cloud, sph_scalars_same(&m), v, &o.sums));
    for (int i = 0; i < N; i++) {
        o.mean += nearest[i] / spacing / N;
        o.close += (nearest[i] < 0.5 * spacing) / (double)N;
    }
    return o;
}

static void count(int picture[ROWS][COLUMNS]) /* particles in a place of the terminal */
{
    memset(picture, 0, ROWS * COLUMNS * sizeof(int));
    for (int i = 0; i < N; i++)
        picture[(int)((y[i] - floor(y[i])) * ROWS)][(int)((x[i] - floor(x[i])) * COLUMNS)]++;
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
            for (column = 0; column < COLUMNS; column++)
                putchar(" .:+*#@"[picture[k][row][column] > 6 ? 6 : picture[k][row][column]]);
            printf(k ? "|\n" : "|  ");
        }
    }
    for (k = 0; k < 3; k++) {
        static const char *const name[] = {"at first:", "without collisions:", "with collisions:"};
        printf("%-19s nearest %.3f of spacing, ", name[k], o[k].mean);
        printf("%5.1f %% within half; energy %.2f\n", 100 * o[k].close, o[k].sums.kinetic_energy);
    }
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
    change = hypot(now.sums.momentum.x - first.sums.momentum.x, now.sums.momentum.y - first.sums.momentum.y);
    if (!(now.close < 0.2 * random.close))
        failed = printf("FAILED: close pairs: %g of all, %g without collisions\n", now.close, random.close);
    if (!(now.mean > 1.4 * random.mean))
        failed = printf("FAILED: neighbours at %g, %g without collisions\n", now.mean, random.mean);
    if (!(fabs(random.mean - 0.5) < 0.05)) /* neighbours of free particles, which are random */
        failed = printf("FAILED: without collisions neighbours are at %g, not half a spacing\n", random.mean);
    if (!(fabs(now.sums.kinetic_energy / first.sums.kinetic_energy - 1) < 1e-11))
        failed = printf("FAILED: energy changes\n");
    if (!(change < 1e-10)) failed = printf("FAILED: momentum changes by %g\n", change);
    if (!failed) printf("ok\n");
    return failed != 0;
}
static void table(void)
{
    puts("state,x,y");
    for (int k = 0; k < 3; k++) { /* at first, without collisions, with */
        fill();
        while (k > 0 && t < 1) step(k == 2);
        for (int i = 0; i < N; i++) printf("%d,%.5g,%.5g\n", k, x[i] - floor(x[i]), y[i] - floor(y[i]));
    }
}
static int save(const char *name) /* as NAME.part, renamed when it is whole; a device is written as it is */
{
    char part[4096];
    snprintf(part, sizeof part, "%.4000s%s", name, strncmp(name, "/dev/", 5) ? ".part" : "");
    if (!setlocale(LC_NUMERIC, "C") || !freopen(part, "wb", stdout)) return perror(name), 2; /* no "1,5" */
    table();
    if (!ferror(stdout) && !fclose(stdout) && (!rename(part, name) || (!remove(name) && !rename(part, name))))
        return 0;
    return perror(name), strcmp(part, name) && remove(part), 2;
}
int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc == 1) return draw(), 0;
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "spread_cloud: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("spread_cloud [-o FILE.csv | -t]   "
                "draw a cloud without and with collisions, write it for a plot, or test it") < 0;
}
