/* SPDX-License-Identifier: MIT
 *
 * gradient_correction.c - the gradient of a field on disordered particles, without and with correction.
 *
 *     cc -O2 -I. -o gradient_correction examples/gradient_correction.c -lm
 *     ./gradient_correction -o gradient.csv
 *
 * The plain sum, sum_j V_j (f_j - f_i) grad W_ij, needs neighbours all around and in order. Near the edge of the cloud half of them are missing, and half of the
 * gradient with them. sph_gradient_cspm multiplies by the inverse of what the sum makes of the coordinates themselves: exact for linear fields, anywhere.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sph.h"

enum { DIM = 2, MOST = 64 * 64, NEIGHBOURS = 40, COLUMNS = 36, ROWS = 18 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double pi = 3.14159265358979324;
static int n;
static double x[MOST], y[MOST], V, h, f[MOST], plain_x[MOST], plain_y[MOST], cspm_x[MOST], cspm_y[MOST];
static sph_index start[MOST + 1], list_index[MOST * NEIGHBOURS];

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    if (failed == 0) return;
    fprintf(stderr, "gradient_correction: %s\n", failed < 0 ? sph_status_text((int)failed) : "particles without a gradient");
    exit(1);
}

/* side x side particles in the unit square, each displaced at random by up to a fifth of the spacing */
static void fill(int side)
{
    const double dx = 1.0 / side;
    uint32_t state = 7;
    int i, c;
    n = side * side;
    V = dx * dx;
    h = 1.3 * dx;
    for (i = 0; i < n; i++) {
        double jitter[2];
        for (c = 0; c < 2; c++) jitter[c] = 0.4 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (i % side + 0.5 + jitter[0]) * dx;
        y[i] = (i / side + 0.5 + jitter[1]) * dx;
    }
}
static sph_list neighbours(sph_points points)
{
    const double radius = sph_kernel_support(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius);
    const size_t size = sph_grid_workspace(DIM, n);
    void *const work = malloc(size);
    sph_grid grid;
    int64_t pairs;
    need(sph_grid_build(DIM, points, radius, work, size, &grid));
    need(sph_grid_lists(DIM, &grid, points, SPH_GATHER, R, R, 0, start, list_index, MOST * NEIGHBOURS, &pairs));
    free(work);
    return (sph_list){start, list_index};
}

static double linear(double px, double py) { return 2 * px - 3 * py + 1; }
static double wave(double px, double py) { return sin(2 * pi * px) * cos(pi * py); }

/* both gradients of a field on side x side particles */
static void gradients(int side, double (*field)(double, double))
{
    sph_points points;
    sph_cloud cloud;
    int i;
    fill(side);
    for (i = 0; i < n; i++) f[i] = field(x[i], y[i]);
    points = sph_points_separate(n, x, y, NULL);
    cloud = sph_cloud_of(points, neighbours(points), sph_scalars_same(&h), sph_scalars_same(&V));
    need(sph_gradient_difference(KERNEL, DIM, cloud, sph_scalars_array(f),
                                 sph_vector_out_separate(plain_x, plain_y, NULL)));
    need(sph_gradient_cspm(KERNEL, DIM, cloud, sph_scalars_array(f),
                           (sph_derivative_out){.gx = cspm_x, .gy = cspm_y}));
}
/* length of the error of particle i against the gradient of the wave */
static double error(int i, const double *gx, const double *gy)
{
    const double ex = gx[i] - 2 * pi * cos(2 * pi * x[i]) * cos(pi * y[i]), ey = gy[i] + pi * sin(2 * pi * x[i]) * sin(pi * y[i]);
    return sqrt(ex * ex + ey * ey);
}
static double largest(const double *gx, const double *gy, int inside) /* inside: only particles whose support is within the square */
{
    const double edge = inside ? sph_kernel_support(KERNEL) * h : 0;
    double most = 0;
    int i;
    for (i = 0; i < n; i++)
        if (x[i] > edge && x[i] < 1 - edge && y[i] > edge && y[i] < 1 - edge) most = fmax(most, error(i, gx, gy));
    return most;
}

/* the largest error in each place of the terminal, a factor of 3 from one character to the next */
static void draw(void)
{
    static const char shade[] = " .:-=+*#%@";
    int row, column, which, i;
    printf("%-*s  %s\n", COLUMNS + 2, "error without correction", "with");
    for (row = 0; row < ROWS; row++) {
        for (which = 0; which < 2; which++) {
            double most[COLUMNS] = {0};
            for (i = 0; i < n; i++)
                if ((int)((1 - y[i]) * ROWS) == row) {
                    column = (int)(x[i] * COLUMNS);
                    most[column] = fmax(most[column], which ? error(i, cspm_x, cspm_y) : error(i, plain_x, plain_y));
                }
            putchar('|');
            for (column = 0; column < COLUMNS; column++) {
                const double level = 8.5 + log(most[column] / (2 * pi) + 1e-30) / log(3);
                putchar(shade[level < 0 ? 0 : level > 9 ? 9 : (int)level]);
            }
            printf("|  ");
        }
        putchar('\n');
    }
    printf("@ more than half of the largest gradient, then a third for each of # * + = - : .\n");
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
    fprintf(file, "x,y,f,error_plain,error_cspm\n");
    for (i = 0; i < n; i++) fprintf(file, "%.6g,%.6g,%.6g,%.6g,%.6g\n", x[i], y[i], f[i], error(i, plain_x, plain_y), error(i, cspm_x, cspm_y));
    if (!ferror(file) && fclose(file) == 0 && (rename(part, name) == 0 || (remove(name) == 0 && rename(part, name) == 0))) return 0;
    perror(name);
    if (strcmp(part, name) != 0) remove(part);
    return 2;
}

static int failed;
static void check(int ok, const char *what, double value)
{
    if (ok) return;
    printf("FAILED: %s: %g\n", what, value);
    failed = 1;
}
static int test(void)
{
    double off = 0, coarse, fine, plain, rough = 0;
    int i;
    gradients(32, linear);
    for (i = 0; i < n; i++) {
        off = fmax(off, fabs(cspm_x[i] - 2) + fabs(cspm_y[i] + 3));
        rough = fmax(rough, fabs(plain_x[i] - 2) + fabs(plain_y[i] + 3));
    }
    check(off < 1e-11, "CSPM is exact for a linear field, at every particle, but is off by", off);
    check(rough > 1 && rough < 5, "without correction about half of it is lost at an edge, but the error is", rough);
    gradients(32, wave);
    coarse = largest(cspm_x, cspm_y, 0);
    gradients(64, wave);
    fine = largest(cspm_x, cspm_y, 0);
    plain = largest(plain_x, plain_y, 0);
    check(log(coarse / fine) / log(2) > 0.7, "CSPM is of first order at edges, but the observed order is", log(coarse / fine) / log(2));
    check(fine < 0.2 * plain, "CSPM has less than a fifth of the plain error, but", fine / plain);
    if (!failed) printf("ok\n");
    return failed;
}

int main(int argc, char **argv)
{
    const int tests = argc == 2 && strcmp(argv[1], "-t") == 0, writes = argc == 3 && strcmp(argv[1], "-o") == 0;
    int side;
    if (argc > 1 && !tests && !writes) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "gradient_correction: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "gradient_correction [-o FILE.csv | -t]   draw the errors, write them for a plot, or test them\n");
        return help ? 0 : 2;
    }
    if (tests) return test();
    gradients(36, wave);
    if (writes) return write_csv(argv[2]);
    draw();
    printf("\nparticles   largest error inside: plain  CSPM      everywhere: plain  CSPM\n");
    for (side = 16; side <= 64; side *= 2) {
        gradients(side, wave);
        printf("%4d x %-4d  %27.3f  %.3f  %18.3f  %.3f\n", side, side, largest(plain_x, plain_y, 1), largest(cspm_x, cspm_y, 1), largest(plain_x, plain_y, 0),
               largest(cspm_x, cspm_y, 0));
    }
    return 0;
}
