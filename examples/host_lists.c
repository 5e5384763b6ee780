/* SPDX-License-Identifier: MIT
 *
 * host_lists.c - a code with its own neighbour lists: the operators without sph.h's search.
 *
 *     cc -O2 -I. -o host_lists examples/host_lists.c -lm
 *     ./host_lists -o blast.csv
 *
 * Such a code includes sph_ops.h only. Here it is one of molecular dynamics: it has linked cells, and a list of pairs i < j. There are two ways in:
 *   1. The pair tier, formulas as functions of values, within the host's own loop over its pairs.
 *   2. The list tier, whole sweeps. They want the neighbours of each particle in a row (CSR): counting, adding up and filling makes that of any list.
 * Both give the same accelerations: those of a gas with a hot spot, which bursts.
 */
#include <stdio.h>
#include <string.h>

#include "sph_ops.h"

enum { DIM = 2, SIDE = 36, N = SIDE * SIDE, PAIRS = 20 * N, CELLS = 13 };
#define KERNEL SPH_CUBIC_SPLINE                      /* a constant: the compiler then folds kernel and dimension away */
static const double h = 1.2 / SIDE, gamma_gas = 1.4; /* the support 2 h = 2.4 / 36 is less than a cell, 1 / 13 */
static double x[N], y[N], vx[N], vy[N], m[N], rho[N], p[N], c[N];
static double ax1[N], ay1[N], heat1[N], ax2[N], ay2[N], heat2[N];
static int pair[PAIRS][2], pairs;

/* -------- the host: particles, linked cells, a list of pairs */

static void fill(void)
{
    uint32_t state = 2;
    int i, k;
    for (i = 0; i < N; i++) {
        double jitter[2], away;
        for (k = 0; k < 2; k++) jitter[k] = 0.2 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (i % SIDE + 0.5 + jitter[0]) / SIDE;
        y[i] = (i / SIDE + 0.5 + jitter[1]) / SIDE;
        away = (x[i] - 0.5) * (x[i] - 0.5) + (y[i] - 0.5) * (y[i] - 0.5);
        vx[i] = 0.3 * sin(6 * y[i]);
        vy[i] = 0.3 * sin(6 * x[i]);
        m[i] = 1.0 / N;
        p[i] = 1 + 10 * exp(-80 * away);
    }
}
static void find_pairs(void)
{
    static int first[CELLS * CELLS], next[N];
    const double reach = sph_kernel_support(KERNEL) * h;
    int i, j, cx, cy;
    memset(first, -1, sizeof first);
    for (i = 0; i < N; i++) {
        int *const cell = &first[(int)(y[i] * CELLS) * CELLS + (int)(x[i] * CELLS)];
        next[i] = *cell;
        *cell = i;
    }
    pairs = 0;
    for (i = 0; i < N; i++)
        for (cy = (int)(y[i] * CELLS) - 1; cy <= (int)(y[i] * CELLS) + 1; cy++)
            for (cx = (int)(x[i] * CELLS) - 1; cx <= (int)(x[i] * CELLS) + 1; cx++) {
                if (cx < 0 || cx >= CELLS || cy < 0 || cy >= CELLS) continue;
                for (j = first[cy * CELLS + cx]; j >= 0; j = next[j])
                    if (j > i && pow(x[i] - x[j], 2) + pow(y[i] - y[j], 2) < reach * reach && pairs < PAIRS)
                        pair[pairs][0] = i, pair[pairs++][1] = j;
            }
}

/* -------- 1. the host's loop, the toolkit's formulas: each pair once, for both of its particles */

static void by_pairs(void)
{
    const sph_viscosity_terms viscosity = {.alpha = 1, .beta = 2, .eta = 0.1};
    int i, q;
    for (i = 0; i < N; i++) {
        rho[i] = m[i] * sph_kernel_w(KERNEL, DIM, 0, h);
        ax1[i] = ay1[i] = heat1[i] = 0;
    }
    for (q = 0; q < pairs; q++) {
        const int a = pair[q][0], b = pair[q][1];
        const double w = sph_kernel_w(KERNEL, DIM, sqrt((x[a] - x[b]) * (x[a] - x[b]) + (y[a] - y[b]) * (y[a] - y[b])), h);
        rho[a] += m[b] * w;
        rho[b] += m[a] * w;
    }
    for (i = 0; i < N; i++) c[i] = sqrt(gamma_gas * p[i] / rho[i]);
    for (q = 0; q < pairs; q++) {
        const int a = pair[q][0], b = pair[q][1];
        const double dx = x[a] - x[b], dy = y[a] - y[b], r = sqrt(dx * dx + dy * dy); /* x_ij = x_i - x_j, everywhere */
        const double vr = (vx[a] - vx[b]) * dx + (vy[a] - vy[b]) * dy;
        const sph_fluid_side at_a = {.rho = rho[a], .p = p[a]}, at_b = {.rho = rho[b], .p = p[b]};
        const sph_encounter e = {vr, r, h, .c = 0.5 * (c[a] + c[b]), .rho = 0.5 * (rho[a] + rho[b])};
        const double Pi = sph_viscosity_pair_monaghan(viscosity, e);
        const double F = sph_kernel_f(KERNEL, DIM, r, h); /* grad_i W = F x_ij */
        const double s = (sph_pressure_pair_monaghan(at_a, at_b) + Pi) * F;
        ax1[a] -= m[b] * s * dx;
        ay1[a] -= m[b] * s * dy;
        ax1[b] += m[a] * s * dx;
        ay1[b] += m[a] * s * dy;
        heat1[a] += 0.5 * m[b] * Pi * vr * F;
        heat1[b] += 0.5 * m[a] * Pi * vr * F;
    }
}

/* -------- 2. the same list as rows, the toolkit's sweep */

static sph_index by_rows(void)
{
    static sph_index start[N + 2], row[2 * PAIRS];
    const sph_points at = sph_points_separate(N, x, y, NULL);
    const sph_vectors v = sph_vectors_separate(vx, vy, NULL);
    const sph_fluid gas = {sph_scalars_array(m), sph_scalars_array(rho), sph_scalars_array(p), sph_scalars_array(c), v, SPH_VISCOSITY_MONAGHAN, 1, 2, 0.1};
    const sph_vector_out acceleration = sph_vector_out_separate(ax2, ay2, NULL);
    const sph_cloud all = sph_cloud_of(at, (sph_list){start, row}, sph_scalars_same(&h), sph_scalars_none());
    int i, q;
    memset(start, 0, sizeof start);
    for (q = 0; q < pairs; q++) { /* count, two places on ... */
        start[pair[q][0] + 2]++;
        start[pair[q][1] + 2]++;
    }
    for (i = 0; i < N; i++) start[i + 2] += start[i + 1]; /* ... add up ... */
    for (q = 0; q < pairs; q++) {                         /* ... and fill, which moves each start by one place */
        row[start[pair[q][0] + 1]++] = pair[q][1];
        row[start[pair[q][1] + 1]++] = pair[q][0];
    }
    return sph_fluid_rates_monaghan(KERNEL, DIM, all, gas, acceleration, NULL, heat2);
}

/* -------- */

static void draw(void) /* the direction of the acceleration, where it is large */
{
    int line, i;
    for (line = SIDE - 2; line >= 0; line -= 2) {
        for (i = line * SIDE; i < (line + 1) * SIDE; i++) {
            const double a = sqrt(ax1[i] * ax1[i] + ay1[i] * ay1[i]);
            const int slope = ay1[i] * ax1[i] > 0 ? '/' : '\\';
            printf("%c ", a < 12 ? '.' : fabs(ax1[i]) > 2 * fabs(ay1[i]) ? '-' : fabs(ay1[i]) > 2 * fabs(ax1[i]) ? '|' : slope);
        }
        printf("\n");
    }
    printf("%d particles, %d pairs: the gas is pushed outwards along these lines\n", (int)N, pairs);
}

static double off(const double *a, const double *b) /* largest difference, relative to the largest number */
{
    double most = 0, size = 0;
    int i;
    for (i = 0; i < N; i++) {
        most = fmax(most, fabs(a[i] - b[i]));
        size = fmax(size, fabs(a[i]));
    }
    return most / size;
}

int main(int argc, char **argv)
{
    const int tests = argc == 2 && strcmp(argv[1], "-t") == 0, writes = argc == 3 && strcmp(argv[1], "-o") == 0;
    double worst, along = 0, exact = 0, momentum = 0;
    char part[4096]; /* renamed when it is whole, so that no half of a file is left; a device is written as it is */
    FILE *file = stdout;
    int i;
    if (argc > 1 && !tests && !writes) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "host_lists: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "host_lists [-o FILE.csv | -t]   draw accelerations, write them for a plot, or test that both ways agree\n");
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
    find_pairs();
    by_pairs();
    const sph_index answer = by_rows();
    worst = fmax(fmax(off(ax1, ax2), off(ay1, ay2)), off(heat1, heat2));
    for (i = 0; i < N; i++) momentum += m[i] * (ax2[i] + ay2[i]);
    for (i = 0; i < N; i++) {
        const double dx = x[i] - 0.5, dy = y[i] - 0.5, size = 1600 * exp(-80 * (dx * dx + dy * dy)); /* -grad p = size (dx, dy), and rho = 1 */
        if (dx * dx + dy * dy > 0.09) continue;                                                      /* the gas has edges, which move by themselves */
        along += size * (ax2[i] * dx + ay2[i] * dy);
        exact += size * size * (dx * dx + dy * dy);
    }
    if (writes) {
        fprintf(file, "x,y,p,ax,ay\n");
        for (i = 0; i < N; i++) fprintf(file, "%.5g,%.5g,%.5g,%.5g,%.5g\n", x[i], y[i], p[i], ax1[i], ay1[i]);
        if (!ferror(file) && fclose(file) == 0 && (rename(part, argv[2]) == 0 || (remove(argv[2]) == 0 && rename(part, argv[2]) == 0))) return 0;
        perror(argv[2]);
        if (strcmp(part, argv[2]) != 0) remove(part);
        return 2;
    }
    if (!tests) draw();
    if (!tests) printf("largest difference of the two ways: %.1e of the largest acceleration\n", worst);
    if (answer) printf("FAILED: %s\n", sph_status_text((int)answer));
    else if (!(worst < 1e-12)) printf("FAILED: the two ways differ by %g\n", worst);
    else if (!(fabs(momentum) < 1e-12)) printf("FAILED: momentum is not conserved: %g\n", momentum);
    else if (!(fabs(along / exact - 1) < 0.1)) printf("FAILED: the acceleration is %g of -grad p / rho\n", along / exact);
    else return tests ? puts("ok") < 0 : 0;
    return 1;
}
