/* SPDX-License-Identifier: MIT
 *
 * gradient_correction.c - the gradient of a field on disordered particles, without and with correction.
 *
 *     cc -O2 -I. -o gradient_correction examples/gradient_correction.c -lm
 *     ./gradient_correction -o gradient.csv
 *
 * The plain sum, sum_j V_j (f_j - f_i) grad W_ij, needs neighbours all around and in order. Near the edge
 * of the cloud half of them are missing, and half of the gradient with them. sph_gradient_cspm multiplies
 * by the inverse of what the sum makes of the coordinates themselves: exact for linear fields, anywhere.
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, MOST = 64 * 64, COLUMNS = 36, ROWS = 18 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double pi = 3.14159265358979324;
static int n;
static double x[MOST], y[MOST], V, h, f[MOST], plain_x[MOST], plain_y[MOST], cspm_x[MOST], cspm_y[MOST];

static void need(sph_index answer) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    const char *const why = answer < 0 ? sph_status_text((int)answer) : "particles without a gradient";
    if (answer) fprintf(stderr, "gradient_correction: %s\n", why), exit(1);
}
static void examine(sph_cloud given) /* a gradient asks for no more than the support of its own particle */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 0, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
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
        for (c = 0; c < 2; c++)
            jitter[c] = 0.4 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (i % side + 0.5 + jitter[0]) * dx;
        y[i] = (i / side + 0.5 + jitter[1]) * dx;
    }
}

static double linear(double px, double py) { return 2 * px - 3 * py + 1; }
static double wave(double px, double py) { return sin(2 * pi * px) * cos(pi * py); }

/* both gradients of a field on side x side particles */
static void gradients(int side, double (*field)(double, double))
{
    static void *memory; /* of the search, and of its lists */
    static size_t size;
    sph_neighbors found;
    sph_index answer;
    fill(side);
    for (int i = 0; i < n; i++) f[i] = field(x[i], y[i]);
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_points points = sph_points_separate(n, x, y, NULL);
    const sph_scalars R = sph_scalars_same(&radius), F = sph_scalars_array(f);
    const sph_vector_out plain = sph_vector_out_separate(plain_x, plain_y, NULL);
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, n, found.pairs));
    need(answer);
    sph_cloud cloud = sph_cloud_of(points, found.list, sph_scalars_same(&h), sph_scalars_same(&V));
    if (EXAMINE) examine(cloud);
    cloud = sph_cloud_checked(DIM, cloud); /* once, for both */
    need(sph_gradient_difference(KERNEL, DIM, cloud, F, plain));
    need(sph_gradient_cspm(KERNEL, DIM, cloud, F, (sph_derivatives_out){.gx = cspm_x, .gy = cspm_y}));
}
/* length of the error of particle i against the gradient of the wave */
static double error(int i, const double *gx, const double *gy)
{
    const double ex = gx[i] - 2 * pi * cos(2 * pi * x[i]) * cos(pi * y[i]);
    const double ey = gy[i] + pi * sin(2 * pi * x[i]) * sin(pi * y[i]);
    return sqrt(ex * ex + ey * ey);
}
/* inside: only of particles whose support is within the square */
static double largest(const double *gx, const double *gy, int inside)
{
    const double edge = inside ? sph_kernel_support_ratio(KERNEL) * h : 0;
    double most = 0;
    for (int i = 0; i < n; i++)
        if (x[i] > edge && x[i] < 1 - edge && y[i] > edge && y[i] < 1 - edge)
            most = fmax(most, error(i, gx, gy));
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
                    most[column] =
                        fmax(most[column], which ? error(i, cspm_x, cspm_y) : error(i, plain_x, plain_y));
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

static int failed;
static void check(int ok, const char *what, double value)
{
    if (ok) return;
    printf("FAILED: %s: %g\n", what, value);
    failed = 1;
}
static int test(void)
{
    double off = 0, coarse, fine, plain, order, rough = 0;
    gradients(32, linear);
    for (int i = 0; i < n; i++) {
        off = fmax(off, fabs(cspm_x[i] - 2) + fabs(cspm_y[i] + 3));
        rough = fmax(rough, fabs(plain_x[i] - 2) + fabs(plain_y[i] + 3));
    }
    check(off < 1e-11, "CSPM is exact for a linear field, at every particle, but is off by", off);
    check(rough > 1 && rough < 5, "without correction about half of it is lost at an edge, but the error is",
          rough);
    gradients(32, wave);
    coarse = largest(cspm_x, cspm_y, 0);
    gradients(64, wave);
    fine = largest(cspm_x, cspm_y, 0);
    plain = largest(plain_x, plain_y, 0);
    order = log(coarse / fine) / log(2);
    check(order > 0.7, "CSPM is of first order at edges, but the observed order is", order);
    check(fine < 0.2 * plain, "CSPM has less than a fifth of the plain error, but", fine / plain);
    if (!failed) printf("ok\n");
    return failed;
}

static void run(void)
{
    gradients(36, wave);
    draw();
    printf("\nparticles   largest error inside: plain  CSPM      everywhere: plain  CSPM\n");
    for (int side = 16; side <= 64; side *= 2) {
        gradients(side, wave);
        printf("%4d x %-4d  %27.3f  %.3f  ", side, side, largest(plain_x, plain_y, 1),
               largest(cspm_x, cspm_y, 1));
        printf("%18.3f  %.3f\n", largest(plain_x, plain_y, 0), largest(cspm_x, cspm_y, 0));
    }
}
static void table(void)
{
    gradients(36, wave);
    puts("x,y,f,error_plain,error_cspm");
    for (int i = 0; i < n; i++)
        printf("%.6g,%.6g,%.6g,%.6g,%.6g\n", x[i], y[i], f[i], error(i, plain_x, plain_y),
               error(i, cspm_x, cspm_y));
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
    if (argc == 1) return run(), 0;
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "gradient_correction: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("gradient_correction [-o FILE.csv | -t]   "
                "draw the errors, write them for a plot, or test them") < 0;
}
