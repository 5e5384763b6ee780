/* SPDX-License-Identifier: MIT
 *
 * host_structs.c - a code with its own array of structs: nothing is copied, neither in nor out.
 *
 *     cc -O2 -I. -o host_structs examples/host_structs.c -lm
 *     ./host_structs -o surface.csv
 *
 * Views say where the numbers are: sph_points_strided and sph_scalars_strided take a pointer to the member
 * of the first struct, and the way to the next one, counted in sph_real. sph_derivatives_icspm writes its
 * results into members, too. The task: slope, Laplacian and status at each point of a surveyed hill.
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, SIDE = 40, N = SIDE * SIDE, COLUMNS = 40, ROWS = 20 };
#define KERNEL SPH_WENDLAND_C4 /* a constant: the compiler then folds kernel and dimension away */

/* the host's own type, with things in it that the toolkit knows nothing of */
typedef struct station {
    char name[8];
    sph_real position[2], height, area, slope[2], laplacian;
    int64_t visits;
} station;
enum { STRIDE = sizeof(station) / sizeof(sph_real) };
typedef char
    size_is_a_multiple[sizeof(station) % sizeof(sph_real) == 0 ? 1 : -1]; /* or no compiler takes it */
static station hill[N];
static unsigned char status[N];

static void need(sph_index answer) /* what a sweep returns: below 0 an error, above 0: see status */
{
    if (answer < 0) fprintf(stderr, "host_structs: %s\n", sph_status_text((int)answer)), exit(1);
}
static void examine(sph_cloud given) /* derivatives ask for no more than the support of their own particle */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 0, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}

/* stations about a tenth of the spacing off a lattice, in random order */
static void survey(double (*height)(double, double))
{
    const double dx = 1.0 / SIDE;
    uint32_t state = 9;
    for (int i = 0; i < N; i++) {
        const double a = (state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5;
        const double b = (state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5;
        station *const s = &hill[i * 7 % N]; /* 7 has no divisor in common with N */
        snprintf(s->name, sizeof s->name, "%c%d", 'A' + i / SIDE % 26, i % SIDE);
        s->position[0] = (i % SIDE + 0.5 + 0.2 * a) * dx;
        s->position[1] = (i / SIDE + 0.5 + 0.2 * b) * dx;
        s->height = height(s->position[0], s->position[1]);
        s->area = dx * dx;
        s->visits++;
    }
}

static void derivatives(void)
{
    const sph_real *const at =
        hill[0].position; /* views: the member of the first struct, the way to the next */
    const sph_points points = sph_points_strided(N, at, at + 1, NULL, STRIDE);
    const sph_scalars area = sph_scalars_strided(&hill[0].area, STRIDE);
    const sph_scalars height = sph_scalars_strided(&hill[0].height, STRIDE);
    const double h = sph_kernel_h_over_dx(KERNEL) / SIDE, radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius);
    /* exact for quadratic fields, at the edge, too; where that is ill-conditioned weighted least squares take
       over (status: SPH_FELL_BACK) */
    const sph_derivatives_options options = {.conditioning_min = 1e-3, .fallback_wls = 1};
    /* what is not asked for stays null */
    sph_derivatives_out out = {.gx = hill->slope, .gy = hill->slope + 1, .laplacian = &hill->laplacian};
    void *memory = NULL;
    size_t size = 0;
    sph_neighbors found;
    sph_cloud cloud;
    sph_index answer;
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, N, found.pairs));
    need(answer);
    cloud = sph_cloud_of(points, found.list, sph_scalars_same(&h), area);
    if (EXAMINE) examine(cloud);
    out.stride = STRIDE, out.status = status;
    need(sph_derivatives_icspm(KERNEL, DIM, cloud, height, options, out));
    free(memory);
}

static double parabola(double x, double y) { return 1 + 2 * x - y + 3 * x * x + 4 * x * y - 2 * y * y; }
static double summit(double x, double y)
{
    const double a = (x - 0.4) * (x - 0.4) + (y - 0.5) * (y - 0.5);
    const double b = (x - 0.8) * (x - 0.8) + (y - 0.7) * (y - 0.7);
    return exp(-8 * a) + 0.5 * exp(-15 * b);
}
static double summit_laplacian(double x, double y)
{
    const double a = (x - 0.4) * (x - 0.4) + (y - 0.5) * (y - 0.5);
    const double b = (x - 0.8) * (x - 0.8) + (y - 0.7) * (y - 0.7);
    return (256 * a - 32) * exp(-8 * a) + 0.5 * (900 * b - 60) * exp(-15 * b);
}
static double error(void) /* root mean square, of the Laplacian of summit */
{
    double sum = 0;
    for (int i = 0; i < N; i++)
        sum += pow(hill[i].laplacian - summit_laplacian(hill[i].position[0], hill[i].position[1]), 2);
    return sqrt(sum / N);
}

/* a map: where water runs, the direction of the steepest descent; o: flat; #: the surface bends down */
static void draw(void)
{
    char map[ROWS][COLUMNS + 1];
    int i, fell_back = 0;
    memset(map, ' ', sizeof map);
    for (i = 0; i < N; i++) {
        const station *const s = &hill[i];
        const double gx = -s->slope[0], gy = -s->slope[1];
        char c = fabs(gx) > fabs(gy) ? (gx > 0 ? '>' : '<') : gy > 0 ? '^' : 'v';
        if (gx * gx + gy * gy < 0.05) c = 'o';
        if (s->laplacian < -20) c = '#';
        map[(int)((1 - s->position[1]) * ROWS)][(int)(s->position[0] * COLUMNS)] = c;
        fell_back += status[i] == SPH_FELL_BACK;
    }
    for (i = 0; i < ROWS; i++) printf("%.*s\n", COLUMNS, map[i]);
    printf("< ^ > v: where water runs; o: flat; #: Laplacian below -20. Fallbacks: %d of %d\n", fell_back,
           (int)N);
    for (i = 0; i < 3; i++) {
        const station *const s = &hill[i];
        printf("%-4s height %6.3f, slope (%6.3f, %6.3f), ", s->name, s->height, s->slope[0], s->slope[1]);
        printf("Laplacian %7.3f\n", s->laplacian);
    }
    printf("error of the Laplacian (root mean square): %.3f\n", error());
}

static int test(void)
{
    double worst = 0;
    int i, damaged = 0, failed = 0;
    survey(parabola);
    derivatives();
    for (i = 0; i < N; i++) {
        const double x = hill[i].position[0], y = hill[i].position[1];
        worst = fmax(worst, fabs(hill[i].slope[0] - (2 + 6 * x + 4 * y)));
        worst = fmax(worst, fabs(hill[i].slope[1] - (-1 + 4 * x - 4 * y)));
        worst = fmax(worst, fabs(hill[i].laplacian - 2));
        damaged += hill[i].visits != 1 || hill[i].name[0] < 'A' || fabs(hill[i].area * N - 1) > 1e-12;
    }
    if (damaged) failed = printf("FAILED: %d stations have lost something\n", damaged);
    if (!(worst < 1e-8)) failed = printf("FAILED: derivatives of a parabola are off by %g\n", worst);
    survey(summit);
    derivatives();
    if (!(error() < 0.8)) failed = printf("FAILED: the Laplacian of the hill is off by %g\n", error());
    if (!failed) printf("ok\n");
    return failed != 0;
}

static void run(int csv)
{
    survey(summit);
    derivatives();
    if (!csv) draw();
    if (csv) puts("x,y,height,slope_x,slope_y,laplacian,status");
    for (int i = 0; i < N && csv; i++) {
        const station *const s = &hill[i];
        printf("%.5g,%.5g,%.5g,", s->position[0], s->position[1], s->height);
        printf("%.5g,%.5g,%.5g,%d\n", s->slope[0], s->slope[1], s->laplacian, status[i]);
    }
}
static int save(const char *name) /* as NAME.part, renamed when it is whole; a device is written as it is */
{
    char part[4096];
    snprintf(part, sizeof part, "%.4000s%s", name, strncmp(name, "/dev/", 5) ? ".part" : "");
    if (!setlocale(LC_NUMERIC, "C") || !freopen(part, "wb", stdout)) return perror(name), 2; /* no "1,5" */
    run(1);
    if (!ferror(stdout) && !fclose(stdout) && (!rename(part, name) || (!remove(name) && !rename(part, name))))
        return 0;
    return perror(name), strcmp(part, name) && remove(part), 2;
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "-o") == 0) return save(argv[2]);
    if (argc == 2 && strcmp(argv[1], "-t") == 0) return test();
    if (argc == 1) return run(0), 0;
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "host_structs: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("host_structs [-o FILE.csv | -t]   "
                "draw where water runs on a hill, write it for a plot, or test the derivatives") < 0;
}
