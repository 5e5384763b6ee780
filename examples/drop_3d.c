/* SPDX-License-Identifier: MIT
 *
 * drop_3d.c - a drop of liquid is squeezed flat: 3D, a free surface, and a solution to compare with.
 *
 *     cc -O2 -I. -o drop_3d examples/drop_3d.c -lm
 *     ./drop_3d -v drop            drop_000.vtk, drop_001.vtk, ... for ParaView
 *
 * A ball of radius 1 starts with the velocity (x, y, -2 z), which is free of divergence. An ideal liquid keeps a velocity that is linear in x, y, z, and the ball becomes an
 * ellipsoid with the semi-axes A, A, C, where p = P (1 - (x^2 + y^2) / A^2 - z^2 / C^2) and
 *     A'' = 2 P / A,   C'' = 2 P / C,   2 P (2 / A^2 + 1 / C^2) = 2 (A'/A)^2 + (C'/C)^2          (density 1; nothing to hold it together)
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sph.h"

enum { DIM = 3, MOST = 3200, PAIRS = 120 * MOST, COLUMNS = 80, ROWS = 17 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const sph_tait liquid = {.rho0 = 1, .c = 20, .gamma = 7}; /* the fastest particle: 2 */
static double dx, h, dt, t, m;
static int n;
static sph_index start[MOST + 1], list_index[PAIRS];
static const sph_list list = {start, list_index};
static double x[DIM][MOST], v[DIM][MOST], a[DIM][MOST], rho[MOST], p[MOST];
static double axis[2] = {1, 1}, speed[2] = {1, -2}; /* A, C of the solution */

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    if (failed == 0) return;
    fprintf(stderr, "drop_3d: t = %g: %s\n", t, failed < 0 ? sph_status_text((int)failed) : "a result overflowed");
    exit(1);
}

static void fill(int across) /* particles along a radius: not more than 9, for MOST in all */
{
    int i, j, k;
    dx = 1.0 / across;
    h = sph_kernel_h_over_dx(KERNEL) * dx;
    dt = sph_time_step_sound(h, liquid.c, 2);
    for (i = -across; i < across; i++)
        for (j = -across; j < across; j++)
            for (k = -across; k < across; k++) {
                const double px = (i + 0.5) * dx, py = (j + 0.5) * dx, pz = (k + 0.5) * dx, r2 = px * px + py * py + pz * pz;
                if (r2 >= 1) continue;
                x[0][n] = v[0][n] = px;
                x[1][n] = v[1][n] = py;
                x[2][n] = pz;
                v[2][n] = -2 * pz;
                p[n] = 1 - r2; /* P = 1 at first */
                rho[n++] = sph_density_tait(1 - r2, liquid);
            }
    m = liquid.rho0 * 4 / 3 * 3.14159265358979324 / n;
}
static sph_vectors velocity(void) { return sph_vectors_separate(v[0], v[1], v[2]); }
static sph_points points(void) { return sph_points_separate(n, x[0], x[1], x[2]); }
static sph_cloud drop(void) { return sph_cloud_of(points(), list, sph_scalars_same(&h), sph_scalars_none()); }

/* continuity for the density, then pressures, then forces */
static void rates(void)
{
    static double divergence[MOST], one = 1;
    static void *work;
    const double radius = sph_kernel_support(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius), mass = sph_scalars_same(&m);
    const sph_scalars density = sph_scalars_array(rho), pressure = sph_scalars_array(p), c = {&liquid.c, 0};
    const sph_gas gas = {mass, density, sph_scalars_same(&one)};
    const sph_vector_out acceleration = sph_vector_out_separate(a[0], a[1], a[2]);
    const sph_fluid fluid = {mass, density, pressure, c, velocity(), SPH_VISCOSITY_MONAGHAN, 0.02, 0, 0.1};
    sph_grid grid;
    int64_t pairs;
    int i;
    if (!work) work = malloc(sph_grid_workspace(DIM, MOST));
    need(sph_grid_build(DIM, points(), radius, work, sph_grid_workspace(DIM, MOST), &grid));
    need(sph_grid_lists(DIM, &grid, points(), SPH_GATHER, R, R, 0, start, list_index, PAIRS, &pairs));
    need(sph_divergence_difference(KERNEL, DIM, drop(), gas, velocity(), divergence));
    for (i = 0; i < n; i++) {
        rho[i] -= dt * rho[i] * divergence[i];
        p[i] = sph_pressure_tait(rho[i], liquid);
    }
    need(sph_fluid_rates_monaghan(KERNEL, DIM, drop(), fluid, acceleration, NULL, NULL));
}
static void add(double to, double rate[DIM][MOST], double value[DIM][MOST])
{
    int i, k;
    for (k = 0; k < DIM; k++)
        for (i = 0; i < n; i++) value[k][i] += to * rate[k][i];
}
static double P(void) /* of the solution, at its centre */
{
    const double a2 = axis[0] * axis[0], c2 = axis[1] * axis[1];
    return (speed[0] * speed[0] / a2 + 0.5 * speed[1] * speed[1] / c2) / (2 / a2 + 1 / c2);
}
static void step(void)
{
    const double now = P();
    int i;
    add(0.5 * dt, a, v); /* kick, drift, kick: leapfrog */
    add(dt, v, x);
    rates();
    add(0.5 * dt, a, v);
    t += dt;
    for (i = 0; i < 2; i++) axis[i] += dt * (speed[i] += dt * 2 * now / axis[i]); /* semi-implicit Euler */
}

/* semi-axes of the particles: the mean of x^2 over an ellipsoid is A^2 / 5 */
static double measured(int which)
{
    double sum = 0;
    int i;
    for (i = 0; i < n; i++) sum += which ? x[2][i] * x[2][i] : 0.5 * (x[0][i] * x[0][i] + x[1][i] * x[1][i]);
    return sqrt(5 * sum / n);
}
static void draw(void) /* seen from the side: the more particles behind each other, the darker */
{
    int picture[ROWS][COLUMNS] = {{0}}, i, row;
    for (i = 0; i < n; i++) {
        const int column = (int)floor((x[0][i] / 3.4 + 0.5) * COLUMNS);
        row = (int)floor((0.5 - x[2][i] / 2.2) * ROWS);
        if (row >= 0 && row < ROWS && column >= 0 && column < COLUMNS) picture[row][column]++;
    }
    for (row = 0; row < ROWS; row++) {
        for (i = 0; i < COLUMNS; i++) putchar(" .:-=+*#%@"[picture[row][i] > 18 ? 9 : (picture[row][i] + 1) / 2]);
        putchar('\n');
    }
    printf("t = %.2f   A = %.3f (exact %.3f)   C = %.3f (exact %.3f)\n", t, measured(0), axis[0], measured(1), axis[1]);
}

static FILE *create(const char *name)
{
    FILE *const file = fopen(name, "w");
    if (file) return file;
    perror(name);
    exit(2);
}
static void write_vtk(const char *prefix, int frame)
{
    char name[256];
    FILE *file;
    int i;
    snprintf(name, sizeof name, "%.240s_%03d.vtk", prefix, frame);
    file = create(name);
    fprintf(file, "# vtk DataFile Version 3.0\ndrop_3d, t = %g\nASCII\nDATASET POLYDATA\nPOINTS %d double\n", t, n);
    for (i = 0; i < n; i++) fprintf(file, "%g %g %g\n", x[0][i], x[1][i], x[2][i]);
    fprintf(file, "POINT_DATA %d\nSCALARS pressure double 1\nLOOKUP_TABLE default\n", n);
    for (i = 0; i < n; i++) fprintf(file, "%g\n", p[i]);
    fprintf(file, "VECTORS velocity double\n");
    for (i = 0; i < n; i++) fprintf(file, "%g %g %g\n", v[0][i], v[1][i], v[2][i]);
    if (ferror(file) || fclose(file)) perror(name), exit(2);
}
static int failed;
static void check(const char *what, double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) < tolerance)) failed = printf("FAILED: %s is %g, not %g\n", what, value, expected);
}
static int test(void)
{
    sph_conserved sums = {0};
    double first, pressure = 0;
    int i;
    fill(6);
    first = measured(0); /* a ball of particles is not quite round */
    for (rates(); t < 0.3;) step();
    need(sph_conserved_sums(DIM, drop(), sph_scalars_same(&m), velocity(), &sums));
    for (i = 0; i < n; i++) pressure += p[i] / n;
    check("A", measured(0) / first, axis[0], 0.02);
    check("C", measured(1) / first, axis[1], 0.01);
    check("the mean pressure, of P", pressure / P(), 0.4, 0.06);
    check("the momentum", sph_length(DIM, sums.momentum), 0, 1e-12);
    return failed ? 1 : puts("ok") < 0;
}

int main(int argc, char **argv)
{
    const int csv = argc == 3 && strcmp(argv[1], "-o") == 0, vtk = argc == 3 && strcmp(argv[1], "-v") == 0;
    char part[4096]; /* renamed when it is whole, so that no half of a file is left; a device is written as it is */
    FILE *file = stdout;
    int frame, i;
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc > 1 && !csv && !vtk) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "drop_3d: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "drop_3d [-o FILE.csv | -v PREFIX | -t]   draw the drop, or write it, or frames, or test it\n");
        return help ? 0 : 2;
    }
    if (csv) snprintf(part, sizeof part, "%.4000s%s", argv[2], strncmp(argv[2], "/dev/", 5) ? ".part" : "");
    if (csv) fprintf(file = create(part), "t,x,y,z,p,A,C\n");
    fill(9);
    rates();
    for (frame = 0; frame <= 20; frame++) {
        while (t < 0.02 * frame - 1e-9) step();
        if (vtk) write_vtk(argv[2], frame);
        for (i = 0; i < n && csv && frame % 10 == 0; i++)
            fprintf(file, "%g,%.4g,%.4g,%.4g,%.4g,%.5g,%.5g\n", 0.02 * frame, x[0][i], x[1][i], x[2][i], p[i], axis[0], axis[1]);
        if (argc == 1 && frame % 10 == 0) draw();
    }
    if (!csv || (!ferror(file) && fclose(file) == 0 && (rename(part, argv[2]) == 0 || (remove(argv[2]) == 0 && rename(part, argv[2]) == 0)))) return 0;
    perror(argv[2]);
    return strcmp(part, argv[2]) ? remove(part), 2 : 2;
}
