/* SPDX-License-Identifier: MIT
 *
 * density_cloud.c - the density of a cloud of random particles, each with a smoothing length that follows
 * it.
 *
 *     cc -O2 -I. -o density_cloud examples/density_cloud.c -lm
 *     ./density_cloud -o cloud.csv
 *
 * N particles of equal mass are drawn from a Gaussian, whose density is known: rho(r) = exp(-r^2 / 2) / (2
 * pi) for a mass of 1 and a width of 1. sph_density_adaptive finds rho_i = sum_j m_j W_ij(h_i) and h_i =
 * ETA (m_i / rho_i)^(1/2) together. A fluid keeps its particles in order and does with an ETA of 1.3.
 * Random positions are noisy: they need many neighbours (4 pi ETA^2), and know nothing of the particle at
 * which the sum is taken, whose own m W(0) makes the density too large by that much. The table has it both
 * ways.
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { N = 6000, DIM = 2, RINGS = 5, COLUMNS = 78, ROWS = 26 };
#define KERNEL SPH_WENDLAND_C2 /* constants: the compiler then folds kernel and dimension away */
static const double ETA = 3.5, pi = 3.14159265358979324;
static double x[N], y[N], h[N], rho[N], omega[N], reach[N], m = 1.0 / N;
static unsigned char status[N];

static void need(sph_index answer) /* what a sweep returns: below 0 an error */
{
    if (answer >= 0) return;
    fprintf(stderr, "density_cloud: %s\n", sph_status_text((int)answer));
    exit(1);
}
static void examine(sph_cloud given) /* the density of a particle asks for no more than its own support */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 0, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}

static double uniform(void) /* within (0, 1) */
{
    static uint64_t state = 42;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return ((double)(state >> 12) + 0.5) / 4503599627370496.0;
}
static void fill(void)
{
    for (int i = 0; i < N; i++) {
        const double r = sqrt(-2 * log(uniform())), angle = 2 * pi * uniform(); /* Box & Muller */
        x[i] = r * cos(angle);
        y[i] = r * sin(angle);
        h[i] = 0.2; /* any guess will do */
    }
}
static double exact(double r) { return exp(-0.5 * r * r) / (2 * pi); }

/* Lists reach as far as the guess of h says. Where that is too short, the operator says what to try next. */
static void density(void)
{
    const double support = sph_kernel_support_ratio(KERNEL);
    const sph_points points = sph_points_separate(N, x, y, NULL);
    const sph_scalars R = sph_scalars_array(reach), mass = sph_scalars_same(&m);
    const sph_density_options options = {.list_radius = R, .eta = ETA, .tolerance = 1e-6};
    const sph_density_out out = {.h = h, .rho = rho, .omega = omega, .status = status};
    void *memory = NULL;
    size_t size = 0;
    sph_neighbors found;
    sph_cloud cloud;
    sph_index failed;
    for (int i = 0; i < N; i++) reach[i] = support * h[i];
    do {
        while ((failed = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
            memory = realloc(memory, size = sph_search_size(DIM, N, found.pairs));
        need(failed);
        cloud = sph_cloud_of(points, found.list, sph_scalars_none(), sph_scalars_none());
        need(failed = sph_density_adaptive(KERNEL, DIM, cloud, mass, options, out));
        for (int i = 0; i < N; i++)
            if (status[i] == SPH_LIST_TOO_SHORT) reach[i] = support * h[i];
            else if (status[i] != SPH_OK) {
                fprintf(stderr, "density_cloud: particle %d: %s\n", i, sph_status_text(status[i]));
                exit(1);
            }
    } while (failed > 0);
    cloud.h = sph_scalars_array(h);
    if (EXAMINE) examine(cloud);
    free(memory);
}

/* densest particle of each place of the terminal, a factor of 2 from one character to the next */
static void draw(void)
{
    static const char shade[] = " .:-=+*#%@";
    double picture[ROWS][COLUMNS] = {{0}};
    int i, row, column;
    for (i = 0; i < N; i++) {
        row = (int)floor((4 - y[i]) / 8 * ROWS);
        column = (int)floor((x[i] + 6) / 12 * COLUMNS);
        if (row >= 0 && row < ROWS && column >= 0 && column < COLUMNS)
            picture[row][column] = fmax(picture[row][column], rho[i]);
    }
    for (row = 0; row < ROWS; row++) {
        for (column = 0; column < COLUMNS; column++) {
            const double level = 9 + log(picture[row][column] / exact(0) + 1e-30) / log(2);
            putchar(picture[row][column] > 0 ? shade[level < 1 ? 1 : level > 9 ? 9 : (int)level] : ' ');
        }
        putchar('\n');
    }
}

/* means over ring k, particles from k/2 to (k + 1)/2 away from the centre: the density, that without the
   particle's own part, and the exact one */
typedef struct ring {
    int count;
    double rho, others, exact;
} ring;
static ring ring_of(int k)
{
    ring a = {0, 0, 0, 0};
    for (int i = 0; i < N; i++) {
        const double r = sqrt(x[i] * x[i] + y[i] * y[i]);
        if ((int)(2 * r) != k) continue;
        a.count++;
        a.rho += rho[i];
        a.others += rho[i] - m * sph_kernel_w(KERNEL, DIM, 0, h[i]);
        a.exact += exact(r);
    }
    a.rho /= a.count;
    a.others /= a.count;
    a.exact /= a.count;
    return a;
}
static void rings(void)
{
    int k;
    printf("radius      particles  density  without the particle's own  exact\n");
    for (k = 0; k < RINGS; k++) {
        const ring a = ring_of(k);
        printf("%.1f to %.1f  %9d  ", 0.5 * k, 0.5 * (k + 1), a.count);
        printf("%7.4f  %26.4f  %.4f\n", a.rho, a.others, a.exact);
    }
}

static int failed;
static void check(const char *what, double value, double expected, double tolerance)
{
    if (fabs(value / expected - 1) < tolerance) return;
    printf("FAILED: %s is %g, not %g\n", what, value, expected);
    failed = 1;
}
static int test(void)
{
    int i, k;
    for (k = 0; k < RINGS - 1; k++) { /* in the last one rho bends too much within h */
        const ring a = ring_of(k);
        check("the density of a ring", a.others, a.exact, 0.05);
    }
    for (i = 0; i < N; i++) check("a smoothing length", h[i], ETA * sqrt(m / rho[i]), 2e-6);
    if (!failed) printf("ok\n");
    return failed;
}

static void table(void)
{
    puts("x,y,h,rho,exact");
    for (int i = 0; i < N; i++)
        printf("%.6g,%.6g,%.6g,%.6g,%.6g\n", x[i], y[i], h[i], rho[i], exact(hypot(x[i], y[i])));
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
    const int writes = argc == 3 && strcmp(argv[1], "-o") == 0, asks = argc == 2 && argv[1][0] == '-';
    if (asks && strcmp(argv[1], "-h") == 0)
        return puts("density_cloud [-o FILE.csv | -t]   draw a cloud, write it for a plot, or test it") < 0;
    if (argc > 1 && !writes && !(asks && strcmp(argv[1], "-t") == 0))
        return fprintf(stderr, "density_cloud: unknown option '%s'; -h lists them\n", argv[1]), 2;
    fill();
    density();
    if (asks) return test();
    if (writes) return save(argv[2]);
    draw();
    rings();
    return 0;
}
