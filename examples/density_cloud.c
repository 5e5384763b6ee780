/* SPDX-License-Identifier: MIT
 *
 * density_cloud.c - the density of a cloud of random particles, each with a smoothing length that follows it.
 *
 *     cc -O2 -I. -o density_cloud examples/density_cloud.c -lm
 *     ./density_cloud -o cloud.csv
 *
 * N particles of equal mass are drawn from a Gaussian, whose density is known: rho(r) = exp(-r^2 / 2) / (2 pi) for a mass of 1 and a width of 1.
 * sph_density_adaptive finds rho_i = sum_j m_j W_ij(h_i) and h_i = ETA (m_i / rho_i)^(1/2) together. A fluid keeps its particles in order and does with an ETA of
 * 1.3. Random positions are noisy: they need many neighbours (4 pi ETA^2), and know nothing of the particle at which the sum is taken, whose own m W(0) makes
 * the density too large by that much. The table has it both ways.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sph.h"

enum { N = 6000, DIM = 2, RINGS = 5, COLUMNS = 78, ROWS = 26 };
#define KERNEL SPH_WENDLAND_C2 /* constants: the compiler then folds kernel and dimension away */
static const double ETA = 3.5, pi = 3.14159265358979324;
static double x[N], y[N], h[N], rho[N], omega[N], reach[N], m = 1.0 / N;
static unsigned char status[N];

static void *must(void *memory)
{
    if (memory) return memory;
    fprintf(stderr, "density_cloud: out of memory\n");
    exit(1);
}
static void need(sph_index answer) /* what a sweep returns: below 0 an error */
{
    if (answer >= 0) return;
    fprintf(stderr, "density_cloud: %s\n", sph_status_text((int)answer));
    exit(1);
}

static double uniform(void) /* within (0, 1) */
{
    static uint64_t state = 42;
    state = state * 6364136223846793005u + 1442695040888963407u;
    return ((double)(state >> 12) + 0.5) / 4503599627370496.0;
}
static void fill(void)
{
    int i;
    for (i = 0; i < N; i++) {
        const double r = sqrt(-2 * log(uniform())), angle = 2 * pi * uniform(); /* Box & Muller */
        x[i] = r * cos(angle);
        y[i] = r * sin(angle);
        h[i] = 0.2; /* any guess will do */
    }
}
static double exact(double r) { return exp(-0.5 * r * r) / (2 * pi); }

/* Lists reach as far as the guess of h says; where that is too short, the operator says what h to try next. */
static void density(void)
{
    const double support = sph_kernel_support(KERNEL);
    const sph_points points = sph_points_separate(N, x, y, NULL);
    const size_t size = sph_grid_workspace(DIM, N);
    void *const work = must(malloc(size));
    sph_index *const start = must(malloc((N + 1) * sizeof *start)), *index = NULL, failed;
    sph_grid grid;
    int64_t pairs;
    int i;
    need(sph_grid_build(DIM, points, support * h[0], work, size, &grid));
    for (i = 0; i < N; i++) reach[i] = support * h[i];
    do {
        const sph_scalars radius = sph_scalars_array(reach), none = sph_scalars_none();
        const sph_density_options options = {.reach = radius, .eta = ETA, .tolerance = 1e-6};
        const sph_density_out out = {h, rho, omega, status};
        need(sph_grid_count(DIM, &grid, points, SPH_GATHER, radius, radius, 0, start, &pairs));
        index = must(realloc(index, (size_t)pairs * sizeof *index));
        need(sph_grid_lists(DIM, &grid, points, SPH_GATHER, radius, radius, 0, start, index, pairs, &pairs));
        const sph_cloud cloud = sph_cloud_of(points, (sph_list){start, index}, none, none);
        failed = sph_density_adaptive(KERNEL, DIM, cloud, sph_scalars_same(&m), options, out);
        need(failed);
        for (i = 0; i < N; i++)
            if (status[i] == SPH_LIST_TOO_SHORT) reach[i] = support * h[i];
            else if (status[i] != SPH_OK) {
                fprintf(stderr, "density_cloud: particle %d at (%g, %g): %s\n", i, x[i], y[i], sph_status_text(status[i]));
                exit(1);
            }
    } while (failed > 0);
    free(index);
    free(start);
    free(work);
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
        if (row >= 0 && row < ROWS && column >= 0 && column < COLUMNS) picture[row][column] = fmax(picture[row][column], rho[i]);
    }
    for (row = 0; row < ROWS; row++) {
        for (column = 0; column < COLUMNS; column++) {
            const double level = 9 + log(picture[row][column] / exact(0) + 1e-30) / log(2);
            putchar(picture[row][column] > 0 ? shade[level < 1 ? 1 : level > 9 ? 9 : (int)level] : ' ');
        }
        putchar('\n');
    }
}

/* means over ring k, particles from k/2 to (k + 1)/2 away from the centre: the density, that without the particle's own part, and the exact one */
typedef struct ring {
    int count;
    double rho, others, exact;
} ring;
static ring ring_of(int k)
{
    ring a = {0, 0, 0, 0};
    int i;
    for (i = 0; i < N; i++) {
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
static void table(void)
{
    int k;
    printf("radius      particles  density  without the particle's own  exact\n");
    for (k = 0; k < RINGS; k++) {
        const ring a = ring_of(k);
        printf("%.1f to %.1f  %9d  %7.4f  %26.4f  %.4f\n", 0.5 * k, 0.5 * (k + 1), a.count, a.rho, a.others, a.exact);
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
    fprintf(file, "x,y,h,rho,exact\n");
    for (i = 0; i < N; i++) fprintf(file, "%.6g,%.6g,%.6g,%.6g,%.6g\n", x[i], y[i], h[i], rho[i], exact(sqrt(x[i] * x[i] + y[i] * y[i])));
    if (!ferror(file) && fclose(file) == 0 && (rename(part, name) == 0 || (remove(name) == 0 && rename(part, name) == 0))) return 0;
    perror(name);
    if (strcmp(part, name) != 0) remove(part);
    return 2;
}

int main(int argc, char **argv)
{
    const int tests = argc == 2 && strcmp(argv[1], "-t") == 0, writes = argc == 3 && strcmp(argv[1], "-o") == 0;
    if (argc > 1 && !tests && !writes) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "density_cloud: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "density_cloud [-o FILE.csv | -t]   draw a cloud, write it for a plot, or test its density\n");
        return help ? 0 : 2;
    }
    fill();
    density();
    if (tests) return test();
    if (writes) return write_csv(argv[2]);
    draw();
    table();
    return 0;
}
