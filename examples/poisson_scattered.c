/* SPDX-License-Identifier: MIT
 *
 * poisson_scattered.c - solves Poisson's equation on scattered points: no mesh, no elements.
 *
 *     cc -O2 -I. -o poisson_scattered examples/poisson_scattered.c -lm
 *     ./poisson_scattered -o poisson.csv
 *
 * lap u = f in the unit square, u given on its edge. The rows of M-SPH (Lukyanov & Vuik 2020) are the matrix: two-point fluxes, and a sparse row for each point.
 * sph_elliptic_rows_boundary writes the rows of the edge, sph_csr_assemble makes a CSR matrix of them all, which any solver reads; the one here is
 * Gauss-Seidel with over-relaxation. f = -5 pi^2 cos(pi x) cos(2 pi y), whose solution is u = cos(pi x) cos(2 pi y).
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sph.h"

enum { DIM = 2, MOST = 65 * 65, NEIGHBOURS = 40, COLUMNS = 64, ROWS = 24 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double pi = 3.14159265358979324;
static double x[MOST], y[MOST], is_edge[MOST], u[MOST], right[MOST]; /* is_edge: 1 or 0 */
static int n, sweeps;
static double residual;

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    if (failed == 0) return;
    fprintf(stderr, "poisson_scattered: %s\n", failed < 0 ? sph_status_text((int)failed) : "points without a row");
    exit(1);
}

static double exact(double px, double py) { return cos(pi * px) * cos(2 * pi * py); }

/* side x side points; those inside are scattered by up to a quarter of the spacing */
static void fill(int side)
{
    const double dx = 1.0 / (side - 1);
    uint32_t state = 11;
    int i, c;
    n = side * side;
    for (i = 0; i < n; i++) {
        const int a = i % side, b = i / side, edge = a == 0 || a == side - 1 || b == 0 || b == side - 1;
        double jitter[2];
        for (c = 0; c < 2; c++) jitter[c] = edge ? 0 : 0.5 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (a + jitter[0]) * dx;
        y[i] = (b + jitter[1]) * dx;
        is_edge[i] = edge;
        right[i] = edge ? exact(x[i], y[i]) : -5 * pi * pi * exact(x[i], y[i]);
        u[i] = 0;
    }
}

/* A u = right by over-relaxation, until the residual is 1e-9 of the right-hand side; the diagonal of row i is the entry whose column is i */
static void solve(int side, const sph_index *start, const sph_index *column, const double *value)
{
    const double omega = 2 / (1 + sin(pi / side));
    double size = 0;
    sph_index p;
    int i;
    for (i = 0; i < n; i++) size = fmax(size, fabs(right[i]));
    for (sweeps = 0, residual = 1; residual > 1e-9 && sweeps < 2000; sweeps++) {
        residual = 0;
        for (i = 0; i < n; i++) {
            double left = right[i], diagonal = 1;
            for (p = start[i]; p < start[i + 1]; p++) {
                left -= value[p] * u[column[p]];
                if (column[p] == i) diagonal = value[p];
            }
            u[i] += omega * left / diagonal;
            residual = fmax(residual, fabs(left) / size);
        }
    }
}

static void poisson(int side)
{
    static sph_index start[MOST + 1], list_index[MOST * NEIGHBOURS], matrix_start[MOST + 1], column[MOST * (NEIGHBOURS + 1)];
    static double row[MOST * NEIGHBOURS], diagonal[MOST], value[MOST * (NEIGHBOURS + 1)];
    static const double one = 1, zero = 0;
    const double dx = 1.0 / (side - 1), h = 1.3 * dx, V = dx * dx, radius = sph_kernel_support(KERNEL) * h;
    const sph_points points = sph_points_separate(n, x, y, NULL);
    const sph_list list = {start, list_index};
    const sph_cloud cloud = sph_cloud_of(points, list, sph_scalars_same(&h), sph_scalars_same(&V));
    const sph_scalars R = sph_scalars_same(&radius), mobility = sph_scalars_same(&one);
    const sph_scalars edge = sph_scalars_array(is_edge), none = sph_scalars_same(&zero);
    /* u = what is given: no slope, so any normal will do */
    const sph_boundary dirichlet = {.normal = {none, none, none}, .alpha = edge, .beta = none};
    const sph_csr matrix = {matrix_start, column, value, MOST * (NEIGHBOURS + 1)};
    const sph_row_out out = {.row = row, .diagonal = diagonal};
    const size_t size = sph_grid_workspace(DIM, n);
    void *const work = malloc(size);
    sph_elliptic_options options = sph_elliptic_defaults();
    unsigned char status[MOST];
    sph_row_out inside = out;
    sph_grid grid;
    int64_t pairs;
    sph_index answer;
    int i;
    need(sph_grid_build(DIM, points, radius, work, size, &grid));
    need(sph_grid_lists(DIM, &grid, points, SPH_GATHER, R, R, 0, start, list_index, MOST * NEIGHBOURS, &pairs));
    options.trace = 1; /* with a source and points in disorder: the right size of the rows, without which solutions do not converge */
    inside.status = status;
    answer = sph_elliptic_rows_msph(KERNEL, DIM, cloud, mobility, options, inside);
    if (answer < 0) need(answer);
    for (i = 0; i < n; i++)
        if (!(is_edge[i] > 0)) need(status[i]); /* rows of the edge may have to do without (SPH_FELL_BACK): they are written over */
    need(sph_elliptic_rows_boundary(KERNEL, DIM, cloud, mobility, options, dirichlet, out));
    need(sph_csr_assemble(cloud, row, diagonal, 1, matrix, NULL));
    free(work);
    solve(side, matrix_start, column, value);
}

static double error(void) /* largest */
{
    double most = 0;
    int i;
    for (i = 0; i < n; i++) most = fmax(most, fabs(u[i] - exact(x[i], y[i])));
    return most;
}

/* the points themselves, from '~' for -1 over ' ' for 0 to '@' for 1 */
static void draw(void)
{
    static const char shade[] = "~~--.  .+*#@";
    char picture[ROWS][COLUMNS + 1];
    int i;
    memset(picture, ' ', sizeof picture);
    for (i = 0; i < n; i++) picture[(int)((1 - y[i]) * (ROWS - 0.01))][(int)(x[i] * (COLUMNS - 0.01))] = shade[(int)(5.99 * (1 + fmax(-1, fmin(1, u[i]))))];
    for (i = 0; i < ROWS; i++) printf("|%.*s|\n", COLUMNS, picture[i]);
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
    fprintf(file, "x,y,u,exact\n");
    for (i = 0; i < n; i++) fprintf(file, "%.6g,%.6g,%.6g,%.6g\n", x[i], y[i], u[i], exact(x[i], y[i]));
    if (!ferror(file) && fclose(file) == 0 && (rename(part, name) == 0 || (remove(name) == 0 && rename(part, name) == 0))) return 0;
    perror(name);
    if (strcmp(part, name) != 0) remove(part);
    return 2;
}

static int test(void)
{
    double e[2], order;
    int k, failed = 0;
    for (k = 0; k < 2; k++) {
        fill(k ? 65 : 33);
        poisson(k ? 65 : 33);
        if (!(residual <= 1e-9)) failed = printf("FAILED: the residual is %g after %d sweeps\n", residual, sweeps);
        e[k] = error();
    }
    order = log(e[0] / e[1]) / log(2);
    if (!(e[1] < 0.02)) failed = printf("FAILED: the largest error is %g\n", e[1]);
    if (!(order > 1.1)) failed = printf("FAILED: the error falls with the power %g of the spacing\n", order);
    if (!failed) printf("ok\n");
    return failed != 0;
}

int main(int argc, char **argv)
{
    const int tests = argc == 2 && strcmp(argv[1], "-t") == 0, writes = argc == 3 && strcmp(argv[1], "-o") == 0;
    int side;
    if (argc > 1 && !tests && !writes) {
        const int help = strcmp(argv[1], "-h") == 0;
        if (!help) fprintf(stderr, "poisson_scattered: unknown option, or no value for it: %s\n", argv[1]);
        fprintf(help ? stdout : stderr, "poisson_scattered [-o FILE.csv | -t]   draw a solution, write it for a plot, or test its error\n");
        return help ? 0 : 2;
    }
    if (tests) return test();
    for (side = writes ? 33 : 17; side <= 65; side = 2 * side - 1) {
        fill(side);
        poisson(side);
        if (writes) return write_csv(argv[2]);
        if (side == 33) draw();
        printf("%d x %d points: largest error %.5f, %d sweeps\n", side, side, error(), sweeps);
    }
    return 0;
}
