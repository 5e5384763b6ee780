/* SPDX-License-Identifier: MIT
 *
 * host_lists.c - a code with its own neighbour lists: the operators without sph.h's search.
 *
 *     cc -O2 -I. -o host_lists examples/host_lists.c -lm
 *     ./host_lists -o blast.csv
 *
 * Such a code includes sph_ops.h only. Here it is one of molecular dynamics: it has linked cells, and a
 * list of pairs i < j. There are two ways in:
 *   1. The pair tier, formulas as functions of values, within the host's own loop over its pairs.
 *   2. The list tier, whole sweeps. They want the neighbours of each particle in a row (CSR): any list turns
 *      into rows by counting, adding up and filling.
 * Both give the same accelerations: those of a gas with a hot spot, which bursts.
 */
#include <locale.h>
#include <stdio.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph_ops.h"

enum { DIM = 2, SIDE = 36, N = SIDE * SIDE, PAIRS = 20 * N, CELLS = 13 };
#define KERNEL SPH_CUBIC_SPLINE /* a constant: the compiler then folds kernel and dimension away */
static const double h = 1.2 / SIDE, gamma_gas = 1.4; /* the support, 2 h = 2.4 / 36, is less than a cell */
static double x[N], y[N], vx[N], vy[N], m[N], rho[N], p[N], c[N];
static double ax1[N], ay1[N], heat1[N], ax2[N], ay2[N], heat2[N];
static int pair[PAIRS][2], pairs;

/* -------- the host: particles, linked cells, a list of pairs */
static void fill(void)
{
    uint32_t state = 2;
    for (int i = 0; i < N; i++) {
        double jitter[2], away;
        for (int k = 0; k < 2; k++)
            jitter[k] = 0.2 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (i % SIDE + 0.5 + jitter[0]) / SIDE;
        y[i] = (i / SIDE + 0.5 + jitter[1]) / SIDE;
        away = (x[i] - 0.5) * (x[i] - 0.5) + (y[i] - 0.5) * (y[i] - 0.5);
        vx[i] = 0.3 * sin(6 * y[i]), vy[i] = 0.3 * sin(6 * x[i]);
        m[i] = 1.0 / N;
        p[i] = 1 + 10 * exp(-80 * away);
    }
}
static void find_pairs(void)
{
    static int first[CELLS * CELLS], next[N];
    const double reach = sph_kernel_support_ratio(KERNEL) * h;
    memset(first, -1, sizeof first);
    for (int i = 0; i < N; i++) {
        int *const cell = &first[(int)(y[i] * CELLS) * CELLS + (int)(x[i] * CELLS)];
        next[i] = *cell;
        *cell = i;
    }
    pairs = 0;
    for (int i = 0; i < N; i++)
        for (int cy = (int)(y[i] * CELLS) - 1; cy <= (int)(y[i] * CELLS) + 1; cy++)
            for (int cx = (int)(x[i] * CELLS) - 1; cx <= (int)(x[i] * CELLS) + 1; cx++) {
                if (cx < 0 || cx >= CELLS || cy < 0 || cy >= CELLS) continue;
                for (int j = first[cy * CELLS + cx]; j >= 0; j = next[j])
                    if (j > i && pow(x[i] - x[j], 2) + pow(y[i] - y[j], 2) < reach * reach && pairs < PAIRS)
                        pair[pairs][0] = i, pair[pairs++][1] = j;
            }
}

/* -------- 1. the host's loop, the toolkit's formulas: each pair once, for both of its particles */
static void by_pairs(void)
{
    const sph_viscosity_terms viscosity = {.alpha = 1, .beta = 2, .eta = 0.1};
    for (int i = 0; i < N; i++) {
        rho[i] = m[i] * sph_kernel_w(KERNEL, DIM, 0, h);
        ax1[i] = ay1[i] = heat1[i] = 0;
    }
    for (int q = 0; q < pairs; q++) {
        const int a = pair[q][0], b = pair[q][1];
        const double r = sqrt((x[a] - x[b]) * (x[a] - x[b]) + (y[a] - y[b]) * (y[a] - y[b]));
        const double w = sph_kernel_w(KERNEL, DIM, r, h);
        rho[a] += m[b] * w, rho[b] += m[a] * w;
    }
    for (int i = 0; i < N; i++) c[i] = sqrt(gamma_gas * p[i] / rho[i]);
    for (int q = 0; q < pairs; q++) {
        const int a = pair[q][0], b = pair[q][1];
        const double dx = x[a] - x[b], dy = y[a] - y[b], r = sqrt(dx * dx + dy * dy); /* x_ij = x_i - x_j */
        const double vr = (vx[a] - vx[b]) * dx + (vy[a] - vy[b]) * dy;
        const sph_fluid_side at_a = {.rho = rho[a], .p = p[a]}, at_b = {.rho = rho[b], .p = p[b]};
        const sph_encounter e = {vr, r, h, .c = 0.5 * (c[a] + c[b]), .rho = 0.5 * (rho[a] + rho[b])};
        const double Pi = sph_viscosity_pair_monaghan(viscosity, e);
        const double F = sph_kernel_f(KERNEL, DIM, r, h); /* grad_i W = F x_ij */
        const double s = (sph_pressure_pair_monaghan(at_a, at_b) + Pi) * F;
        ax1[a] -= m[b] * s * dx, ay1[a] -= m[b] * s * dy;
        ax1[b] += m[a] * s * dx, ay1[b] += m[a] * s * dy;
        heat1[a] += 0.5 * m[b] * Pi * vr * F, heat1[b] += 0.5 * m[a] * Pi * vr * F;
    }
}

/* -------- 2. the same list as rows, the toolkit's sweep */

static void examine(sph_cloud given) /* with both sides of pairs: forces are symmetric */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 1, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}
static sph_index by_rows(void)
{
    static sph_index start[N + 2], row[2 * PAIRS];
    const sph_points at = sph_points_separate(N, x, y, NULL);
    const sph_vectors v = sph_vectors_separate(vx, vy, NULL);
    const sph_scalars mass = sph_scalars_array(m), density = sph_scalars_array(rho);
    const sph_scalars pressure = sph_scalars_array(p), sound = sph_scalars_array(c);
    const sph_fluid gas = {mass, density, pressure, sound, v, SPH_VISCOSITY_MONAGHAN, 1, 2, 0.1};
    const sph_fluid_out out = {.acceleration = sph_vector_out_separate(ax2, ay2, NULL), .heating = heat2};
    const sph_cloud all = sph_cloud_of(at, (sph_list){start, row}, sph_scalars_same(&h), sph_scalars_none());
    memset(start, 0, sizeof start);
    for (int q = 0; q < pairs; q++) /* count, two places on ... */
        start[pair[q][0] + 2]++, start[pair[q][1] + 2]++;
    for (int i = 0; i < N; i++) start[i + 2] += start[i + 1]; /* ... add up ... */
    for (int q = 0; q < pairs; q++) { /* ... and fill, which moves each start by one place */
        row[start[pair[q][0] + 1]++] = pair[q][1];
        row[start[pair[q][1] + 1]++] = pair[q][0];
    }
    if (EXAMINE) examine(all);
    return sph_fluid_rates_monaghan(KERNEL, DIM, all, gas, out);
}

static void draw(void) /* the direction of the acceleration, where it is large */
{
    for (int line = SIDE - 2; line >= 0; line -= 2) {
        for (int i = line * SIDE; i < (line + 1) * SIDE; i++) {
            const double a = sqrt(ax1[i] * ax1[i] + ay1[i] * ay1[i]), flat = fabs(ax1[i]) / fabs(ay1[i]);
            const int slope = ay1[i] * ax1[i] > 0 ? '/' : '\\';
            printf("%c ", a < 12 ? '.' : flat > 2 ? '-' : flat < 0.5 ? '|' : slope);
        }
        printf("\n");
    }
    printf("%d particles, %d pairs: the gas is pushed outwards along these lines\n", (int)N, pairs);
}
static double off(const double *a, const double *b) /* largest difference, relative to the largest number */
{
    double most = 0, size = 0;
    for (int i = 0; i < N; i++) {
        most = fmax(most, fabs(a[i] - b[i]));
        size = fmax(size, fabs(a[i]));
    }
    return most / size;
}
static int run(int quiet)
{
    double worst, along = 0, exact = 0, momentum = 0;
    const sph_index answer = by_rows();
    worst = fmax(fmax(off(ax1, ax2), off(ay1, ay2)), off(heat1, heat2));
    for (int i = 0; i < N; i++) {
        const double dx = x[i] - 0.5, dy = y[i] - 0.5;
        const double size = 1600 * exp(-80 * (dx * dx + dy * dy)); /* -grad p = size (dx, dy), and rho = 1 */
        momentum += m[i] * (ax2[i] + ay2[i]);
        if (dx * dx + dy * dy > 0.09) continue; /* the gas has edges, which move by themselves */
        along += size * (ax2[i] * dx + ay2[i] * dy);
        exact += size * size * (dx * dx + dy * dy);
    }
    if (!quiet) draw();
    if (!quiet) printf("largest difference of the two ways: %.1e of the largest acceleration\n", worst);
    if (answer) printf("FAILED: %s\n", sph_status_text((int)answer));
    else if (!(worst < 1e-12)) printf("FAILED: the two ways differ by %g\n", worst);
    else if (!(fabs(momentum) < 1e-12)) printf("FAILED: momentum is not conserved: %g\n", momentum);
    else if (!(fabs(along / exact - 1) < 0.1)) printf("FAILED: %g of -grad p / rho\n", along / exact);
    else return 0;
    return 1;
}
static void table(void)
{
    puts("x,y,p,ax,ay");
    for (int i = 0; i < N; i++) printf("%.5g,%.5g,%.5g,%.5g,%.5g\n", x[i], y[i], p[i], ax1[i], ay1[i]);
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
    fill();
    find_pairs();
    by_pairs();
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return run(1) || puts("ok") < 0;
    if (argc == 1) return run(0);
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "host_lists: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("host_lists [-o FILE.csv | -t]   "
                "draw accelerations, write them for a plot, or test that both ways agree") < 0;
}
