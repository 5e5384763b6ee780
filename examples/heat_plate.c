/* SPDX-License-Identifier: MIT
 *
 * heat_plate.c - heat spreads through a square plate from its hot edge.
 *
 *     cc -O2 -I. -o heat_plate examples/heat_plate.c -lm
 *     ./heat_plate -o plate.csv
 *
 * dT/dt = div(m grad T) on particles that are not in order, by M-SPH (Lukyanov & Vuik 2020). Nothing moves,
 * so the operator is made once, as rows of weights: each step then is one pass over them, sph_rows_apply,
 * and the longest stable step comes from the rows, too. The left edge has T = 1, the others T = 0.
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, SIDE = 33, N = SIDE * SIDE };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double pi = 3.14159265358979324, conductivity = 1;
static const double dx = 1.0 / (SIDE - 1), h = 1.3 / (SIDE - 1), V = 1.0 / ((SIDE - 1) * (SIDE - 1));
static double x[N], y[N], temperature[N], rate[N], dt, t;
static double *row;     /* one weight for each pair */
static sph_cloud cloud; /* nothing moves: checked once, for all steps */

static void need(sph_index answer) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    const char *const why = answer < 0 ? sph_status_text((int)answer) : "particles without an answer";
    if (answer) fprintf(stderr, "heat_plate: %s\n", why), exit(1);
}
static void examine(sph_cloud given) /* M-SPH sums over pairs: both sides */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 1, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}

static int on_edge(int i)
{
    return i % SIDE == 0 || i % SIDE == SIDE - 1 || i / SIDE == 0 || i / SIDE == SIDE - 1;
}

/* a square lattice with its edge on that of the plate; inside, particles are displaced at random by up to a
   tenth of the spacing */
static void fill(void)
{
    uint32_t state = 3;
    int i, c;
    for (i = 0; i < N; i++) {
        double jitter[2];
        for (c = 0; c < 2; c++)
            jitter[c] = 0.2 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (i % SIDE + (on_edge(i) ? 0 : jitter[0])) * dx;
        y[i] = (i / SIDE + (on_edge(i) ? 0 : jitter[1])) * dx;
    }
}

static void make_rows(void)
{
    const sph_points points = sph_points_separate(N, x, y, NULL);
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius), m = sph_scalars_same(&conductivity);
    const sph_elliptic_options options = {0};
    void *memory = NULL;
    size_t size = 0;
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, N, found.pairs));
    need(answer);
    cloud = sph_cloud_of(points, found.list, sph_scalars_same(&h), sph_scalars_same(&V));
    if (EXAMINE) examine(cloud);
    cloud = sph_cloud_checked(DIM, cloud);
    row = malloc((size_t)found.pairs * sizeof *row);
    need(sph_elliptic_rows_msph(KERNEL, DIM, cloud, m, options, (sph_rows_out){.row = row}));
    need(sph_rows_time_step(cloud, row, &dt));
    dt *= 0.5; /* half of the longest stable step, so that nothing ever gets hotter than its neighbourhood */
}

static void step(void) /* explicit Euler; the particles on the edge keep their temperature */
{
    const sph_scalars T = sph_scalars_array(temperature), no_diagonal = sph_scalars_none();
    need(sph_rows_apply(cloud, row, no_diagonal, T, sph_scalar_out_array(rate, NULL)));
    for (int i = 0; i < N; i++)
        if (!on_edge(i)) temperature[i] += dt * rate[i];
    t += dt;
}

static void heat_left_edge(void)
{
    for (int i = 0; i < N; i++) temperature[i] = i % SIDE == 0 ? 1 : 0;
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
    /* all edges cold: sin(pi x) sin(pi y) keeps its shape and decays as exp(-2 pi^2 m t) */
    for (int i = 0; i < N; i++) temperature[i] = on_edge(i) ? 0 : sin(pi * x[i]) * sin(pi * y[i]);
    first = temperature[centre];
    while (t < 0.1) step();
    check("the rate of decay", log(first / temperature[centre]) / t / (2 * pi * pi * conductivity), 1, 0.02);
    /* left edge hot, in the end: four such plates, one turned to each side, add up to 1: 1/4 in the centre */
    heat_left_edge();
    while (t < 0.5) {
        step();
        for (int i = 0; i < N; i++) {
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

static void run(int csv)
{
    static const double times[] = {0.002, 0.02, 0.2};
    heat_left_edge();
    if (csv) puts("t,x,y,temperature");
    for (int k = 0; k < 3; k++) {
        while (t < times[k]) step();
        for (int i = 0; i < N && csv; i++)
            printf("%g,%.5g,%.5g,%.5g\n", times[k], x[i], y[i], temperature[i]);
        if (!csv) draw();
    }
    if (!csv) printf("in the centre: %.4f; 0.25 in the end\n", temperature[SIDE / 2 * SIDE + SIDE / 2]);
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
    fill();
    make_rows();
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc == 1) return run(0), 0;
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "heat_plate: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("heat_plate [-o FILE.csv | -t]   "
                "draw the plate at three times, write them for a plot, or test them") < 0;
}
