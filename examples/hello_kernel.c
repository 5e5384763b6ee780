/* SPDX-License-Identifier: MIT
 *
 * hello_kernel.c - draws a smoothing kernel W and its slope -dW/dr.
 *
 *     cc -O2 -I. -o hello_kernel examples/hello_kernel.c -lm
 *     ./hello_kernel -k quintic-spline
 *
 * The smallest use of the toolkit: functions of numbers, no particles yet. -l says what each kernel makes of
 * the density of a perfect lattice.
 */
#include <locale.h>
#include <stdio.h>
#include <string.h>

#include "sph.h"

enum { COLUMNS = 64, ROWS = 20, DIM = 2 };
static const double h = 1; /* smoothing length; the kernel ends at sph_kernel_support_ratio(k) * h */

static void draw(sph_kernel k)
{
    const double support = sph_kernel_support_ratio(k) * h;
    char picture[ROWS + 1][COLUMNS + 1];
    double w[COLUMNS + 1], slope[COLUMNS + 1], highest = 0;
    int row, column;
    for (column = 0; column <= COLUMNS; column++) {
        const double r = support * column / COLUMNS;
        w[column] = sph_kernel_w(k, DIM, r, h);
        slope[column] = -sph_kernel_dwdr(k, DIM, r, h);
        highest = fmax(highest, fmax(w[column], slope[column]));
    }
    memset(picture, ' ', sizeof picture);
    for (column = 0; column <= COLUMNS; column++) {
        const int at = (int)(ROWS * slope[column] / highest + 0.5),
                  up = (int)(ROWS * w[column] / highest + 0.5);
        if (at >= 0) picture[at][column] = 'o'; /* a few kernels have lobes below 0, which are not drawn */
        if (up >= 0) picture[up][column] = '#';
    }
    printf("%s in %dD: W = # and -dW/dr = o over r, h = %g\n", sph_kernel_name(k), (int)DIM, h);
    for (row = ROWS; row >= 0; row--)
        printf("%6.3f |%.*s\n", highest * row / ROWS, COLUMNS + 1, picture[row]);
    printf("       0%*.2f = %g h\n", COLUMNS, support, sph_kernel_support_ratio(k));
    printf("W(0) = %.6f, W(h) = %.6f, ", sph_kernel_w(k, DIM, 0, h), sph_kernel_w(k, DIM, h, h));
    printf("F(h) = (1/r) dW/dr = %.6f\n", sph_kernel_f(k, DIM, h, h));
}

/* The density that a kernel sums up on a lattice of spacing 1 and density 1, at the recommended h. */
static double lattice_density(sph_kernel k, int dim)
{
    const double wide = sph_kernel_h_over_dx(k);
    const int n = (int)sph_kernel_support(k, wide), ny = dim > 1 ? n : 0, nz = dim > 2 ? n : 0;
    double rho = 0;
    for (int z = -nz; z <= nz; z++)
        for (int y = -ny; y <= ny; y++)
            for (int x = -n; x <= n; x++) rho += sph_kernel_w(k, dim, sqrt(x * x + y * y + z * z), wide);
    return rho;
}

static int lattices(void)
{
    puts("kernel                h/dx     1D     2D     3D");
    for (int k = 0; k < (int)SPH_KERNEL_COUNT; k++) {
        printf("%-20s %5.1f", sph_kernel_name((sph_kernel)k), sph_kernel_h_over_dx((sph_kernel)k));
        for (int dim = 1; dim <= 3; dim++) printf("  %.3f", lattice_density((sph_kernel)k, dim));
        printf("\n");
    }
    return 0;
}

static void table(void)
{
    static const sph_kernel kernels[] = {SPH_CUBIC_SPLINE, SPH_QUINTIC_SPLINE, SPH_WENDLAND_C2,
                                         SPH_WENDLAND_C6};
    puts("kernel,r,W,slope");
    for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++)
        for (int i = 0; i <= 120; i++) {
            const double r = 3.0 * i / 120, slope = -sph_kernel_dwdr(kernels[k], DIM, r, h);
            const double w = sph_kernel_w(kernels[k], DIM, r, h);
            printf("%s,%g,%.9g,%.9g\n", sph_kernel_name(kernels[k]), r, w, slope);
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

static int failed;
static void check(sph_kernel k, int dim, const char *what, double value, double expected)
{
    if (fabs(value - expected) < 1e-6) return;
    printf("FAILED: %s in %dD: %s is %.9g, not %.9g\n", sph_kernel_name(k), dim, what, value, expected);
    failed = 1;
}

/* Every kernel in 1D, 2D and 3D: is its integral 1, and is F = (1/r) dW/dr the slope of W? */
static int test(void)
{
    static const double pi = 3.14159265358979324;
    const double sphere[] = {2, 2 * pi, 4 * pi}; /* of radius 1: two points, a circle, a sphere */
    enum { STEPS = 12000 };
    int k, dim, i;
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++)
        for (dim = 1; dim <= 3; dim++) {
            const sph_kernel kernel = (sph_kernel)k;
            const double step = sph_kernel_support_ratio(kernel) * h / STEPS, r = 0.7 * h, d = 1e-5;
            const double after = sph_kernel_w(kernel, dim, r + d, h),
                         before = sph_kernel_w(kernel, dim, r - d, h);
            double integral = 0;
            for (i = 0; i < STEPS; i++) { /* midpoint rule */
                const double s = (i + 0.5) * step;
                integral += sphere[dim - 1] * pow(s, dim - 1) * sph_kernel_w(kernel, dim, s, h) * step;
            }
            check(kernel, dim, "the integral", integral, 1);
            check(kernel, dim, "F r", sph_kernel_f(kernel, dim, r, h) * r, (after - before) / (2 * d));
        }
    if (!failed) printf("ok\n");
    return failed;
}

static int usage(const char *option)
{
    const int help = strcmp(option, "-h") == 0;
    FILE *const to = help ? stdout : stderr;
    int k;
    if (!help) fprintf(to, "hello_kernel: unknown option, or no (good) value for it: %s\n", option);
    fprintf(to, "hello_kernel [-k KERNEL] [-o FILE.csv] [-l] [-t]\n");
    fprintf(to, "draw a kernel, write a few for a plot, list the density of a lattice, or test\nKERNEL:");
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++)
        fprintf(to, "%s %s", k % 5 ? "" : "\n   ", sph_kernel_name((sph_kernel)k));
    fprintf(to, "\n");
    return help ? 0 : 2;
}

int main(int argc, char **argv)
{
    int k = (int)SPH_WENDLAND_C2, i;
    for (i = 1; i < argc; i++) {
        if (strcmp(argv[i], "-t") == 0) return test();
        if (strcmp(argv[i], "-l") == 0) return lattices();
        if (strcmp(argv[i], "-o") == 0 && i + 1 < argc) return save(argv[i + 1]);
        if (strcmp(argv[i], "-k") != 0 || ++i == argc) return usage(argv[i < argc ? i : argc - 1]);
        k = sph_kernel_from_name(argv[i]);
        if (k < 0) return usage(argv[i]);
    }
    draw((sph_kernel)k);
    return 0;
}
