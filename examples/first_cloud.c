/* SPDX-License-Identifier: MIT
 *
 * first_cloud.c - from a file of points to a gradient in four steps, and what the likely mistakes look like.
 *
 *     cc -O2 -I. -o first_cloud examples/first_cloud.c -lm
 *     ./first_cloud -i points.csv -o gradient.csv
 *
 * A line of the file is x,y,f: a point and the value of a field there, at any distances of about one size.
 * The result has x,y,f,gx,gy,answer: the gradient of f, and what sph_status_text says of the point. Without a
 * file the points are a disordered lattice in a box that repeats, f = sin(2 pi x), and six clouds are
 * compared: a right one, and five with a mistake each that no check of arguments can see.
 */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMINE 0 /* 1: prints what is likely wrong with the right cloud */
#define SPH_REFUSED(argument, particle, error) \
    fprintf(stderr, "%s: %s, first at point %d\n", argument, sph_status_text(error), (int)(particle))
#include "sph.h"

enum { DIM = 2, SIDE = 30, MOST = 200000 };
enum { RIGHT, SHORT, SUPPORT, MASSES, NO_BOX, OLD, CLOUDS };
#define KERNEL SPH_WENDLAND_C2
static const char *const cloud_name[CLOUDS] = {
    "right", "lists as long as h, not as its support", "the radius of the support as h",
    "masses as volumes", "lists know the box, points do not", "lists from before the points have moved",
};
static const double two_pi = 6.283185307179586;
static double x[MOST], y[MOST], f[MOST], volume[MOST], gx[MOST], gy[MOST], sum[MOST];
static unsigned char status[MOST];
static double h, box;
static int n, own; /* own: the points are from a file */

static void need(sph_index answer)
{
    if (answer < 0) fprintf(stderr, "first_cloud: %s\n", sph_status_text((int)answer)), exit(1);
}

/* Step 1: points, and a value at each of them. */
static double shaken(void) /* within (0.3, 0.7) */
{
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return 0.3 + 0.4 * state / 4294967296.0;
}
static void fill(void)
{
    for (n = 0; n < SIDE * SIDE; n++) {
        x[n] = (n % SIDE + shaken()) / SIDE;
        y[n] = (n / SIDE + shaken()) / SIDE;
        f[n] = sin(two_pi * x[n]);
    }
    box = 1;
}
static void read_points(const char *name)
{
    FILE *const from = fopen(name, "r");
    char line[256];
    int at = 0;
    if (!from) perror(name), exit(2);
    for (n = 0; fgets(line, sizeof line, from); at++) {
        if (n < MOST && sscanf(line, "%lf%*[,; \t]%lf%*[,; \t]%lf", &x[n], &y[n], &f[n]) == 3) n++;
        else if (at > 0) /* the first line may be a heading */
            fprintf(stderr, "%s: line %d is not x,y,f, or is one too many\n", name, at + 1), exit(2);
    }
    fclose(from);
    box = 0;
}

/* Step 2: h from the distance of the points, and who is near whom. */
static double spacing(void)
{
    double left = x[0], right = x[0], low = y[0], high = y[0];
    for (int i = 0; i < n; i++) {
        left = fmin(left, x[i]), right = fmax(right, x[i]);
        low = fmin(low, y[i]), high = fmax(high, y[i]);
    }
    return sqrt((right - left) * (high - low)) / (sqrt(n) - 1); /* points that fill a rectangle */
}
static sph_cloud neighbours(double radius)
{
    static void *memory;
    static size_t size;
    const sph_points open = sph_points_separate(n, x, y, NULL);
    const sph_points points = sph_points_periodic(open, box, box, 0);
    sph_neighbors found;
    sph_index answer;
    while ((answer = sph_search(DIM, points, sph_scalars_same(&radius), SPH_GATHER, memory, size, &found)) ==
           SPH_ERROR_CAPACITY)
        if (!(memory = realloc(memory, size = sph_search_size(DIM, n, found.pairs)))) exit(1);
    need(answer);
    return sph_cloud_of(points, found.list, sph_scalars_same(&h), sph_scalars_none());
}

/* Step 3: the volume of each point, here the inverse of how many there are around it. */
static void volumes(sph_cloud cloud)
{
    const double one = 1;
    cloud.volume = sph_scalars_same(&one);
    need(sph_shepard_sum(KERNEL, DIM, cloud, sph_scalar_out_array(sum, NULL)));
    for (int i = 0; i < n; i++) volume[i] = 1 / sum[i];
}

/* Step 4: an operator. */
static void all_steps(void)
{
    const sph_derivatives_out out = {.gx = gx, .gy = gy, .stride = 1, .status = status};
    sph_cloud cloud;
    h = spacing() * sph_kernel_h_over_dx(KERNEL);
    cloud = neighbours(sph_kernel_support(KERNEL, h));
    volumes(cloud);
    cloud.volume = sph_scalars_array(volume);
    need(sph_gradient_cspm(KERNEL, DIM, cloud, sph_scalars_array(f), out));
}

/* What no check of arguments sees, sph_cloud_examine does. The sum of V W is near 1 in a right cloud. */
static sph_findings cloud_with(int mistake)
{
    static double mass[SIDE * SIDE], moved[SIDE * SIDE];
    const double support = sph_kernel_support(KERNEL, h);
    sph_findings found = {0};
    sph_cloud cloud = neighbours(mistake == SHORT ? h : support);
    for (int i = 0; i < n; i++) mass[i] = 1000 * volume[i], moved[i] = x[i] + 6 * y[i] / SIDE;
    cloud.volume = sph_scalars_array(mistake == MASSES ? mass : volume);
    if (mistake == SUPPORT) cloud.h = sph_scalars_same(&support);
    if (mistake == NO_BOX) cloud.points = sph_points_separate(n, x, y, NULL);
    if (mistake == OLD) cloud.points.x = moved;
    need(sph_shepard_sum(KERNEL, DIM, cloud, sph_scalar_out_array(sum, NULL)));
    sph_cloud_examine(KERNEL, DIM, cloud, 0, 0, &found);
    return found;
}
static void draw(void)
{
    for (int k = 0; k < CLOUDS; k++) {
        const sph_findings found = cloud_with(k);
        double low = sum[0], high = sum[0];
        for (int i = 0; i < n; i++) low = fmin(low, sum[i]), high = fmax(high, sum[i]);
        printf("%s: sum of V W from %.3g to %.3g\n", cloud_name[k], low, high);
        for (int i = 0; i < SPH_FINDING_COUNT; i++)
            if (found.set >> i & 1)
                fprintf(EXAMINE && k == RIGHT ? stderr : stdout, "    %.*s\n",
                        (int)fmin(76, (double)strcspn(sph_finding_text(i), ".:")), sph_finding_text(i));
    }
}
static void table(void)
{
    puts(own ? "x,y,f,gx,gy,answer" : "cloud,x,y,h,sum");
    for (int i = 0; i < n && own; i++)
        printf("%.17g,%.17g,%.17g,%.10g,%.10g,%s\n", x[i], y[i], f[i], gx[i], gy[i],
               sph_status_text(status[i]));
    for (int k = 0; k < CLOUDS && !own; k++) {
        cloud_with(k);
        for (int i = 0; i < n; i++) printf("%d,%.6g,%.6g,%.6g,%.5g\n", k, x[i], y[i], h, sum[i]);
    }
}

static int test(void)
{
    double worst = 0, exact = 0;
    int failed = 0, i;
    for (i = 0; i < n; i++) worst = fmax(worst, fabs(gx[i] - two_pi * cos(two_pi * x[i])));
    if (!(worst < 0.5)) failed = printf("FAILED: the gradient is off by %g\n", worst);
    for (i = 0; i < CLOUDS; i++)
        if ((cloud_with(i).set == 0) != (i == RIGHT))
            failed = printf("FAILED: the doctor and '%s'\n", cloud_name[i]);
    for (i = 0; i < n; i++) f[i] = 2 * x[i] - 3 * y[i] + 1;
    box = 0; /* as if from a file: exact up to the edge */
    all_steps();
    for (i = 0; i < n; i++) exact = fmax(exact, fmax(fabs(gx[i] - 2), fabs(gy[i] + 3)));
    if (!(exact < 1e-10)) failed = printf("FAILED: the gradient of a plane is off by %g\n", exact);
    if (!failed) printf("ok\n");
    return failed != 0;
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
    own = argc == 5 && !strcmp(argv[1], "-i") && !strcmp(argv[3], "-o");
    if (argc == 2 && strcmp(argv[1], "-h") == 0)
        return puts("first_cloud [[-i POINTS.csv] -o FILE.csv | -t]   see mistakes, or get a gradient") < 0;
    if (argc > 1 && !own && !(argc == 3 && !strcmp(argv[1], "-o")) && !(argc == 2 && !strcmp(argv[1], "-t")))
        return fprintf(stderr, "first_cloud: unknown option '%s', or no file; -h lists them\n", argv[1]), 2;
    if (own) read_points(argv[2]);
    else fill();
    all_steps();
    if (argc == 2) return test();
    return argc == 1 ? draw(), 0 : save(argv[argc - 1]);
}
