/* SPDX-License-Identifier: MIT
 *
 * drop_3d.c - a drop of liquid is squeezed flat: 3D, a free surface, and a solution to compare with.
 *
 *     cc -O2 -I. -o drop_3d examples/drop_3d.c -lm
 *     ./drop_3d -v drop            drop_000.vtk, drop_001.vtk, ... for ParaView, one each 0.02 of time
 *
 * A ball of radius 1 starts with the velocity (x, y, -2 z), which is free of divergence. An ideal liquid
 * keeps a velocity that is linear in x, y, z, and the ball becomes an ellipsoid with the semi-axes A, A, C,
 * where p = P (1 - (x^2 + y^2) / A^2 - z^2 / C^2) and
 *     A'' = 2 P / A,   C'' = 2 P / C,   2 P (2 / A^2 + 1 / C^2) = 2 (A'/A)^2 + (C'/C)^2
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 3, MOST = 3200, COLUMNS = 80, ROWS = 17 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const sph_tait liquid = {.rho0 = 1, .c = 20, .gamma = 7}; /* the fastest particle: 2 */
static int n, failed;
static sph_cloud drop;
static double dx, h, dt, t, m, x[DIM][MOST], v[DIM][MOST], a[DIM][MOST], rho[MOST], p[MOST];
static double axis[2] = {1, 1}, speed[2] = {1, -2}; /* A, C of the solution */
static void need(sph_index answer) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    const char *const why = answer < 0 ? sph_status_text((int)answer) : "a result overflowed";
    if (answer) fprintf(stderr, "drop_3d: t = %g: %s\n", t, why), exit(1);
}
static void examine(sph_cloud given) /* with both sides of pairs: forces are symmetric */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 1, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}
static void rates(void) /* continuity for the density, then pressures, then forces */
{
    static double divergence[MOST], one = 1;
    static void *memory; /* of the search: from step to step */
    static size_t size;
    const sph_points points = sph_points_separate(n, x[0], x[1], x[2]);
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius), H = sph_scalars_same(&h), mass = sph_scalars_same(&m);
    const sph_vectors velocity = sph_vectors_separate(v[0], v[1], v[2]);
    const sph_scalars density = sph_scalars_array(rho), pressure = sph_scalars_array(p), c = {&liquid.c, 0};
    const sph_medium gas = {mass, density, sph_scalars_same(&one)};
    const sph_fluid_out force = {.acceleration = sph_vector_out_separate(a[0], a[1], a[2])};
    const sph_fluid fluid = {mass, density, pressure, c, velocity, SPH_VISCOSITY_MONAGHAN, 0.02, 0, 0.1};
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, n, found.pairs));
    need(answer);
    drop = sph_cloud_checked(DIM, sph_cloud_of(points, found.list, H, sph_scalars_none()));
    if (EXAMINE && t == 0) examine(drop);
    need(sph_divergence_difference(KERNEL, DIM, drop, gas, velocity, sph_scalar_out_array(divergence, 0)));
    for (int i = 0; i < n; i++) {
        rho[i] -= dt * rho[i] * divergence[i];
        p[i] = sph_pressure_tait(rho[i], liquid);
    }
    need(sph_fluid_rates_monaghan(KERNEL, DIM, drop, fluid, force));
}
static void fill(int across) /* particles along a radius: not more than 9, for MOST in all */
{
    dx = 1.0 / across, h = sph_kernel_h_over_dx(KERNEL) * dx;
    dt = sph_time_step_sound(h, liquid.c, 2);
    for (int i = -across; i < across; i++)
        for (int j = -across; j < across; j++)
            for (int k = -across; k < across; k++) {
                const double px = (i + 0.5) * dx, py = (j + 0.5) * dx, pz = (k + 0.5) * dx;
                const double r2 = px * px + py * py + pz * pz;
                if (r2 >= 1) continue;
                x[0][n] = v[0][n] = px, x[1][n] = v[1][n] = py;
                x[2][n] = pz, v[2][n] = -2 * pz, p[n] = 1 - r2; /* P = 1 at first */
                rho[n++] = sph_density_tait(1 - r2, liquid);
            }
    m = liquid.rho0 * 4 / 3 * 3.14159265358979324 / n;
    rates();
}
static void add(double to, double rate[DIM][MOST], double value[DIM][MOST])
{
    for (int k = 0; k < DIM; k++)
        for (int i = 0; i < n; i++) value[k][i] += to * rate[k][i];
}
static double P(void) /* of the solution, at its centre */
{
    const double a2 = axis[0] * axis[0], c2 = axis[1] * axis[1];
    return (speed[0] * speed[0] / a2 + 0.5 * speed[1] * speed[1] / c2) / (2 / a2 + 1 / c2);
}
static void step(void)
{
    const double now = P();
    add(0.5 * dt, a, v), add(dt, v, x); /* kick, drift, kick: leapfrog */
    rates();
    add(0.5 * dt, a, v);
    t += dt;
    for (int i = 0; i < 2; i++) axis[i] += dt * (speed[i] += dt * 2 * now / axis[i]); /* symplectic Euler */
}
static double measured(int which) /* a semi-axis: the mean of x^2 over an ellipsoid is A^2 / 5 */
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += which ? pow(x[2][i], 2) : 0.5 * (pow(x[0][i], 2) + pow(x[1][i], 2));
    return sqrt(5 * sum / n);
}
static void draw(void) /* seen from the side: the more particles behind each other, the darker */
{
    int picture[ROWS][COLUMNS] = {{0}};
    for (int i = 0; i < n; i++) {
        const int column = (int)floor((x[0][i] / 3.4 + 0.5) * COLUMNS);
        const int row = (int)floor((0.5 - x[2][i] / 2.2) * ROWS);
        if (row >= 0 && row < ROWS && column >= 0 && column < COLUMNS) picture[row][column]++;
    }
    for (int row = 0; row < ROWS; row++) {
        for (int i = 0; i < COLUMNS; i++) putchar(" .:-=+*#%@"[(int)fmin(9, (picture[row][i] + 1) / 2)]);
        putchar('\n');
    }
    printf("t = %.2f   A = %.3f (exact %.3f)   ", t, measured(0), axis[0]);
    printf("C = %.3f (exact %.3f)\n", measured(1), axis[1]);
}
static void number(FILE *file, double value) /* as legacy VTK has it: the highest byte first */
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int shift = 56; shift >= 0; shift -= 8) putc((int)(bits >> shift & 255), file);
}
static void write_vtk(const char *prefix, int frame) /* in binary: as text, numbers depend on the locale */
{
    char name[4096];
    snprintf(name, sizeof name, "%.4000s_%03d.vtk", prefix, frame);
    FILE *const file = fopen(name, "wb");
    if (!file) perror(name), exit(2);
    fprintf(file, "# vtk DataFile Version 3.0\ndrop_3d\nBINARY\nDATASET POLYDATA\nPOINTS %d double\n", n);
    for (int i = 0; i < n * DIM; i++) number(file, x[i % DIM][i / DIM]);
    fprintf(file, "\nVERTICES %d %d\n", n, 2 * n); /* each of 1 point: nothing else would be drawn */
    for (int i = 0; i < n; i++) fprintf(file, "%c%c%c%c%c%c%c%c", 0, 0, 0, 1, i >> 24, i >> 16, i >> 8, i);
    fprintf(file, "\nPOINT_DATA %d\nSCALARS pressure double 1\nLOOKUP_TABLE default\n", n);
    for (int i = 0; i < n; i++) number(file, p[i]);
    fprintf(file, "\nVECTORS velocity double\n");
    for (int i = 0; i < n * DIM; i++) number(file, v[i % DIM][i / DIM]);
    if (ferror(file) || fclose(file)) perror(name), exit(2);
}
static void check(const char *what, double value, double expected, double off)
{
    if (!(fabs(value - expected) < off)) failed = printf("FAILED: %s is %g, not %g\n", what, value, expected);
}
static int test(void)
{
    sph_conserved sums = {0};
    double first, pressure = 0;
    fill(6);
    first = measured(0); /* a ball of particles is not quite round */
    while (t < 0.3) step();
    need(sph_conserved_sums(DIM, drop, sph_scalars_same(&m), sph_vectors_separate(v[0], v[1], v[2]), &sums));
    for (int i = 0; i < n; i++) pressure += p[i] / n;
    check("A", measured(0) / first, axis[0], 0.02);
    check("C", measured(1) / first, axis[1], 0.01);
    check("the mean pressure, of P", pressure / P(), 0.4, 0.06);
    check("the momentum", sph_length(DIM, sums.momentum), 0, 1e-12);
    return failed ? 1 : puts("ok") < 0;
}
static void run(int csv, const char *vtk)
{
    fill(9);
    if (csv) printf("t,x,y,z,p,A,C\n");
    for (int frame = 0; frame <= 20; frame++) {
        while (t < 0.02 * frame - 1e-9) step();
        if (vtk) write_vtk(vtk, frame);
        for (int i = 0; i < n && csv && frame % 10 == 0; i++)
            printf("%g,%.4g,%.4g,%.4g,%.4g,%.5g,%.5g\n", 0.02 * frame, x[0][i], x[1][i], x[2][i], p[i],
                   axis[0], axis[1]);
        if (!csv && !vtk && frame % 10 == 0) draw();
    }
}
static int save(const char *name) /* as NAME.part, renamed when it is whole; a device is written as it is */
{
    char part[4096];
    snprintf(part, sizeof part, "%.4000s%s", name, strncmp(name, "/dev/", 5) ? ".part" : "");
    if (!setlocale(LC_NUMERIC, "C") || !freopen(part, "wb", stdout)) return perror(name), 2; /* no "1,5" */
    run(1, NULL);
    if (!ferror(stdout) && !fclose(stdout) && (!rename(part, name) || (!remove(name) && !rename(part, name))))
        return 0;
    return perror(name), strcmp(part, name) && remove(part), 2;
}
int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 3 && strcmp(argv[1], "-v") == 0) return run(0, argv[2]), 0;
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc == 1) return run(0, NULL), 0;
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "drop_3d: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("drop_3d [-o FILE.csv | -v PREFIX | -t]   draw the drop, write it or frames, or test it") < 0;
}
