/* SPDX-License-Identifier: MIT
 *
 * clean_field.c - cleans the divergence out of a vector field.
 *
 *     cc -O2 -I. -o clean_field examples/clean_field.c -lm
 *     ./clean_field -o field.csv
 *
 * A magnetic field has no divergence; what a simulation gathers of it by mistake is carried away as waves
 * of a scalar psi, and damped on the way:
 *     dB/dt = -grad psi,   dpsi/dt = -ch^2 div B - sigma ch psi / h      (Tricco & Price 2012, JCP 231, 7214)
 * The two operators of sph_cleaning_rates are adjoint, so that energy moves between B and psi and only
 * damping takes any. Here: a uniform field with a bump in Bx, in a periodic box that stands still (a code
 * that moves gives div v, too).
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the first cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at particle %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, SIDE = 50, N = SIDE * SIDE };
#define KERNEL SPH_QUINTIC_SPLINE /* a constant: the compiler then folds kernel and dimension away */
static const double dx = 1.0 / SIDE, h = 1.0 / SIDE, m = 1.0 / N, ch = 1, sigma = 0.3;
static double x[N], y[N], rho[N], Bx[N], By[N], psi[N], rate_x[N], rate_y[N], rate_psi[N], div_B[N], t;
static sph_cloud cloud; /* nothing moves: checked once, for all steps */

static void need(sph_index failed) /* what a sweep returns: 0, or how many particles failed, or an error */
{
    const char *const why = failed < 0 ? sph_status_text((int)failed) : "a result overflowed";
    if (failed) fprintf(stderr, "clean_field: %s\n", why), exit(1);
}

static void examine(sph_cloud given) /* with both sides of pairs: the operators are symmetric */
{
    sph_findings found = {0}; /* stays so if there is an error, which the sweeps tell */
    sph_cloud_examine(KERNEL, DIM, given, 1, 0, &found);
    for (int i = 0; i < SPH_FINDING_COUNT; i++)
        if (found.set >> i & 1)
            fprintf(stderr, "particle %d, neighbour %d, ratio %g: %s\n", (int)found.at[i].particle,
                    (int)found.at[i].neighbour, found.at[i].ratio, sph_finding_text(i));
}

/* a hexagonal lattice, slightly in disorder, its density, and the field */
static void fill(void)
{
    const double radius = sph_kernel_support_ratio(KERNEL) * h;
    const sph_scalars R = sph_scalars_same(&radius);
    const sph_points points = sph_points_periodic(sph_points_separate(N, x, y, NULL), 1, 1, 0);
    static void *memory; /* of the search, and of its lists */
    static size_t size;
    uint32_t state = 5;
    sph_neighbors found;
    sph_index answer;
    for (int i = 0; i < N; i++) {
        double jitter[2], r;
        for (int c = 0; c < 2; c++)
            jitter[c] = 0.1 * ((state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
        x[i] = (i % SIDE + 0.25 + 0.5 * (i / SIDE % 2) + jitter[0]) * dx;
        y[i] = (i / SIDE + 0.5 + jitter[1]) * dx;
        r = fmin(8 * ((x[i] - 0.5) * (x[i] - 0.5) + (y[i] - 0.5) * (y[i] - 0.5)), 1);
        Bx[i] = (1 - r) * (1 - r) * (1 - r); /* a bump with a radius of 0.35 */
        By[i] = 0.5;
        psi[i] = 0;
    }
    t = 0;
    while ((answer = sph_search(DIM, points, R, SPH_GATHER, memory, size, &found)) == SPH_ERROR_CAPACITY)
        memory = realloc(memory, size = sph_search_size(DIM, N, found.pairs));
    need(answer);
    cloud = sph_cloud_of(points, found.list, sph_scalars_same(&h), sph_scalars_none()); /* masses will do */
    if (EXAMINE) examine(cloud);
    cloud = sph_cloud_checked(DIM, cloud);
    need(sph_density_summation(KERNEL, DIM, cloud, sph_scalars_same(&m), sph_scalar_out_array(rho, NULL)));
}

static void rates(double damping)
{
    static const double one = 1; /* Omega of an h that is constant */
    const sph_medium gas = {sph_scalars_same(&m), sph_scalars_array(rho), sph_scalars_same(&one)};
    const sph_cleaning state = {.medium = gas,
                                .field = sph_vectors_separate(Bx, By, NULL),
                                .psi = sph_scalars_array(psi),
                                .ch = ch,
                                .sigma = damping};
    const sph_cleaning_out out = {
        .rate_B = sph_vector_out_separate(rate_x, rate_y, NULL), .rate_psi = rate_psi, .div_B = div_B};
    need(sph_cleaning_rates(KERNEL, DIM, cloud, state, out));
}
static void step(double dt, double damping) /* the midpoint rule: first half a step */
{
    static double Bx0[N], By0[N], psi0[N];
    memcpy(Bx0, Bx, sizeof Bx);
    memcpy(By0, By, sizeof By);
    memcpy(psi0, psi, sizeof psi);
    for (int half = 1; half <= 2; half++) {
        const double to = 0.5 * half * dt;
        rates(damping);
        for (int i = 0; i < N; i++) {
            Bx[i] = Bx0[i] + to * rate_x[i];
            By[i] = By0[i] + to * rate_y[i];
            psi[i] = psi0[i] + to * rate_psi[i];
        }
    }
    t += dt;
}

typedef struct sums {
    double divergence, energy, field; /* rms of h div B; of B and psi; the mean of Bx, which is conserved */
} sums;
static sums measure(void)
{
    sums s = {0, 0, 0};
    rates(sigma);
    for (int i = 0; i < N; i++) {
        s.divergence += h * h * div_B[i] * div_B[i] / N;
        s.energy += m * (Bx[i] * Bx[i] + By[i] * By[i] + psi[i] * psi[i] / (ch * ch)) / (2 * rho[i]);
        s.field += m * Bx[i] / rho[i];
    }
    s.divergence = sqrt(s.divergence);
    return s;
}

/* |h div B|: a factor of 2 from one character to the next, one for each particle of every other row */
static void draw(void)
{
    for (int line = SIDE - 1; line >= 0; line -= 2) {
        putchar('|');
        for (int i = line * SIDE; i < (line + 1) * SIDE; i++) {
            const double level = 9 + log(fabs(h * div_B[i]) / 0.05 + 1e-30) / log(2);
            putchar(" .:-=+*#%@"[level < 0 ? 0 : level > 9 ? 9 : (int)level]);
        }
        printf("|\n");
    }
}
static void report(void)
{
    const sums s = measure();
    printf("t = %.2f   rms of h div B: %.6f   ", t, s.divergence);
    printf("energy: %.6f   mean of Bx: %.6f\n", s.energy, s.field);
}

static int test(void)
{
    const double dt = 0.3 * h / ch;
    sums first, now;
    int i, failed = 0;
    fill();
    first = measure();
    for (i = 0; i < 30; i++) step(dt, 0);
    now = measure();
    if (!(fabs(now.energy / first.energy - 1) < 1e-5))
        failed = printf("FAILED: undamped energy changes by a factor of %g\n", now.energy / first.energy);
    if (!(now.divergence < 0.7 * first.divergence)) failed = printf("FAILED: waves leave the divergence\n");
    for (fill(); t < 0.7;) step(dt, sigma);
    now = measure();
    if (!(now.divergence < 0.1 * first.divergence))
        failed = printf("FAILED: %g of the divergence is left\n", now.divergence / first.divergence);
    if (!(now.energy < first.energy)) failed = printf("FAILED: energy grows\n");
    if (!(fabs(now.field - first.field) < 1e-13))
        failed = printf("FAILED: the mean field changes by %g\n", now.field - first.field);
    if (!failed) printf("ok\n");
    return failed != 0;
}

static void run(int csv)
{
    static const double times[] = {0, 0.2, 1};
    fill();
    if (csv) puts("t,x,y,Bx,By,h_div_B");
    for (int k = 0; k < 3; k++) {
        while (t < times[k]) step(0.3 * h / ch, sigma);
        rates(sigma);
        for (int i = 0; i < N && csv; i++)
            printf("%g,%.5g,%.5g,%.5g,%.5g,%.5g\n", times[k], x[i], y[i], Bx[i], By[i], h * div_B[i]);
        if (!csv) draw(), report();
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
    if (strcmp(argv[1], "-h") != 0) return fprintf(stderr, "clean_field: unknown option '%s'; -h lists them\n", argv[1]), 2;
    return puts("clean_field [-o FILE.csv | -t]   "
                "draw the divergence at three times, write it for a plot, or test the cleaning") < 0;
}
