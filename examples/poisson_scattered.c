/* SPDX-License-Identifier: MIT
 *
 * poisson_scattered.c - solves Poisson's equation on scattered points: no mesh, no elements.
 *
 *     cc -O2 -I. -o poisson_scattered examples/poisson_scattered.c -lm
 *     ./poisson_scattered -o poisson.csv
 *
 * lap u = f in the unit square, u given on its edge. The rows of M-SPH (Lukyanov & Vuik 2020) are the
 * matrix: two-point fluxes, and a sparse row for each point. sph_elliptic_rows_boundary writes the rows of
 * the edge, sph_csr_assemble makes a CSR matrix of them all, which any solver reads; the one here is
 * Gauss-Seidel with over-relaxation. f = -5 pi^2 cos(pi x) cos(2 pi y), whose solution is u = cos(pi x)
 * cos(2 pi y).
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, MOST = 65 * 65, COLUMNS = 64, ROWS = 24 };
#define KERNEL SPH_WENDLAND_C2 /* a constant: the compiler then folds kernel and dimension away */
static const double pi = 3.14159265358979324;
static double x[MOST], y[MOST], is_edge[MOST], u[MOST], right[MOST]; /* is_edge: 1 or 0 */
static int n, sweeps;
static double residual;

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    const char *const why = failed < 0 ? sph_status_text((int)failed) : "points without a row";
    if (failed) fprintf(stderr, "poisson_scattered: %s\n", why), exit(1);
}
static void examine(sph_cloud given) /* M-SPH sums over pairs: both sides */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 1, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}

static double exact(double px, double py) { return cos(pi * px) * cos(2 * pi * py); }

/* side x side points; those inside are scattered by up to a quarter of the spacing */
static void fill(int side)
{
    const double dx = 1.0 / (side - 1);
    uint32_t state = 11;
    n = side * side;
    for (int i = 0; i < n; i++) {
        const int a = i % side, b = i / side, edge = a == 0 || a == side - 1 || b == 0 || b == side - 1;
        double jitter[2];
        for (int c = 0; c < 2; c++)
            jitter[c] = edge ? 0 : 0.5 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (a + jitter[0]) * dx;
        y[i] = (b + jitter[1]) * dx;
        is_edge[i] = edge;
        right[i] = edge ? exact(x[i], y[i]) : -5 * pi * pi * exact(x[i], y[i]);
        u[i] = 0;
    }
}

/* A u = right by over-relaxation, until the residual is 1e-9 of the right-hand side; the diagonal of row i is
   the entry whose column is i */
static void solve(int side, const sph_index *start, const sph_index *column, const double *value)
{
    const double omega = 2 / (1 + sin(pi / side));
    double size = 0;
    for (int i = 0; i < n; i++) size = fmax(size, fabs(right[i]));
    for (sweeps = 0, residual = 1; residual > 1e-9 && sweeps < 2000; sweeps++) {
        residual = 0;
        for (int i = 0; i < n; i++) {
            double left = right[i], diagonal = 1;
            for (sph_index p = start[i]; p < start[i + 1]; p++) {
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
    static sph_index matrix_start[MOST + 1];
    static double diagonal[MOST];
    static unsigned char status[MOST];
    static const double one = 1, zero = 0;
    const double dx = 1.0 / (side - 1), h = 1.3 * dx, V = dx * dx;
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_points points = sph_points_separate(n, x, y, NULL);
    const sph_scalars R = sph_scalars_same(&radius), mobility = sph_scalars_same(&one);
    const sph_scalars edge = sph_scalars_array(is_edge), none = sph_scalars_same(&zero);
    /* u = what is given: no slope, so any normal will do */
    const sph_boundary dirichlet = {.normal = {none, none, none}, .alpha = edge, .beta = none};
    /* with a source and points in disorder: the right size of rows, or nothing converges */
    const sph_elliptic_options options = {.trace = 1};
    sph_rows_out out = {.diagonal = diagonal, .status = status};
    sph_csr matrix = {.start = matrix_start};
    void *memory = NULL;
    size_t size = 0;
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, n, found.pairs));
    need(answer);
    sph_cloud cloud = sph_cloud_of(points, found.list, sph_scalars_same(&h), sph_scalars_same(&V));
    if (EXAMINE) examine(cloud);
    cloud = sph_cloud_checked(DIM, cloud);                   /* once, for three calls */
    out.row = malloc((size_t)found.pairs * sizeof *out.row); /* null is refused, with a name */
    answer = sph_elliptic_rows_msph(KERNEL, DIM, cloud, mobility, options, out);
    if (answer < 0) need(answer);
    for (int i = 0; i < n; i++) /* the rows of the edge may be what they like: they are written over */
        if (!(is_edge[i] > 0)) need(status[i]);
    need(sph_elliptic_rows_boundary(KERNEL, DIM, cloud, mobility, options, dirichlet, out));
    matrix.capacity = sph_csr_size(cloud);
    matrix.column = malloc((size_t)matrix.capacity * sizeof *matrix.column);
    matrix.value = malloc((size_t)matrix.capacity * sizeof *matrix.value);
    need(sph_csr_assemble(cloud, out.row, sph_scalars_array(diagonal), 1, matrix, NULL));
    solve(side, matrix.start, matrix.column, matrix.value);
    free(matrix.value), free(matrix.column), free(out.row), free(memory);
}

static double error(void) /* largest */
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(u[i] - exact(x[i], y[i])));
    return most;
}

/* the points themselves, from '~' for -1 over ' ' for 0 to '@' for 1 */
static void draw(void)
{
    static const char shade[] = "~~--.  .+*#@";
    char picture[ROWS][COLUMNS + 1];
    memset(picture, ' ', sizeof picture);
    for (int i = 0; i < n; i++) {
        const int row = (int)((1 - y[i]) * (ROWS - 0.01)), column = (int)(x[i] * (COLUMNS - 0.01));
        picture[row][column] = shade[(int)(5.99 * (1 + fmax(-1, fmin(1, u[i]))))];
    }
    for (int i = 0; i < ROWS; i++) printf("|%.*s|\n", COLUMNS, picture[i]);
}

static int test(void)
{
    double e[2], order;
    int k, failed = 0;
    for (k = 0; k < 2; k++) {
        fill(k ? 65 : 33);
        poisson(k ? 65 : 33);
        if (!(residual <= 1e-9)) failed = printf("FAILED: the residual is %g\n", residual);
        e[k] = error();
    }
    order = log(e[0] / e[1]) / log(2);
    if (!(e[1] < 0.02)) failed = printf("FAILED: the largest error is %g\n", e[1]);
    if (!(order > 1.1)) failed = printf("FAILED: the error falls with the power %g of the spacing\n", order);
    if (!failed) printf("ok\n");
    return failed != 0;
}

static void run(void)
{
    for (int side = 17; side <= 65; side = 2 * side - 1) {
        fill(side);
        poisson(side);
        if (side == 33) draw();
        printf("%d x %d points: largest error %.5f, %d sweeps\n", side, side, error(), sweeps);
    }
}
static void table(void)
{
    fill(33);
    poisson(33);
    puts("x,y,u,exact");
    for (int i = 0; i < n; i++) printf("%.6g,%.6g,%.6g,%.6g\n", x[i], y[i], u[i], exact(x[i], y[i]));
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
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "poisson_scattered: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("poisson_scattered [-o FILE.csv | -t]   "
                "draw a solution, write it for a plot, or test its error") < 0;
}
