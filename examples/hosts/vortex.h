/* SPDX-License-Identifier: MIT
 *
 * vortex.h - the Orszag-Tang vortex with divergence cleaning, with the settings of
 * examples/papers/cleaning_orszag_tang.c, so that it can stay on a device: search, densities with their own h, rates
 * and steps. The same functions run on the host for a range of particles, in OpenCL (vortex.cl) and in CUDA
 * (host_cuda_vortex.cu) for one particle an item. All numbers of the gas lie in one array, a[ARRAY * n + i], and
 * those of the whole gas in number[].
 */
#ifndef HOSTS_VORTEX_H
#define HOSTS_VORTEX_H

#include "lists.h"

#define VORTEX_KERNEL SPH_CUBIC_SPLINE
/* Arrays: X, Y, RADIUS in this order for the lists; then what evolves, its rates, and those of the step before */
enum {
    VX,
    VY,
    BX,
    BY,
    U,
    PSI,
    ALPHA,
    EVOLVED,
    X = 0,
    Y,
    RADIUS,
    NOW,
    RATE = NOW + EVOLVED,
    BEFORE = RATE + EVOLVED,
    H = BEFORE + EVOLVED,
    RHO,
    OMEGA,
    M,
    P,
    CS,
    FAST,  /* the fastest wave across the field */
    SPEED, /* the largest signal speed */
    DIV_V,
    DIV_B,
    HASTE, /* 1 / the longest step, without Courant's number */
    ARRAYS
};
enum { LARGEST_RADIUS, LARGEST_FAST, LARGEST_HASTE, COURANT, TIME, NOTHING, NUMBERS };
enum { VORTEX_PAIRS = 80 }; /* room in the lists, for each particle */

/* What the sweeps take of particles first ... last - 1 */
SPH_FN sph_cloud vortex_cloud(int first, int last, int n, const SPH_GLOBAL sph_real *a,
                              const SPH_GLOBAL sph_index *start, const SPH_GLOBAL sph_index *index)
{
    const sph_points x = sph_points_periodic(sph_points_separate(n, a + X * n, a + Y * n, 0), SPH_R(1), SPH_R(1), SPH_R(0));
    sph_list list;
    list.start = start;
    list.index = index;
    return sph_cloud_range(sph_cloud_of(x, list, sph_scalars_array(a + H * n), sph_scalars_none()), first, last);
}
SPH_FN sph_real vortex_dt(const SPH_GLOBAL sph_real *number) { return number[COURANT] / number[LARGEST_HASTE]; }

/* The first half of a step: positions, and a prediction by Euler's rule of all that evolves. The radius of the lists
   is a tenth longer than the support of a first guess of h. */
SPH_FN void vortex_predict(int first, int last, int n, SPH_GLOBAL sph_real *a, const SPH_GLOBAL sph_real *number)
{
    const sph_real dt = vortex_dt(number);
    int i, f;
    for (i = first; i < last; i++) {
        for (f = 0; f < 2; f++)
            a[(X + f) * n + i] += dt * (a[(NOW + VX + f) * n + i] + SPH_R(0.5) * dt * a[(RATE + VX + f) * n + i]);
        for (f = 0; f < EVOLVED; f++) {
            a[(NOW + f) * n + i] += dt * a[(RATE + f) * n + i];
            a[(BEFORE + f) * n + i] = a[(RATE + f) * n + i];
        }
        a[H * n + i] *= SPH_R(1) + SPH_R(0.5) * dt * a[DIV_V * n + i];
    }
}
SPH_FN void vortex_reach(int first, int last, int n, SPH_GLOBAL sph_real *a)
{
    int i;
    for (i = first; i < last; i++) a[RADIUS * n + i] = SPH_R(1.1) * sph_kernel_support(VORTEX_KERNEL, a[H * n + i]);
}
/* h, density and Omega, and what follows from them. Returns how many have none. */
SPH_FN sph_index vortex_density(int first, int last, int n, SPH_GLOBAL sph_real *a, const SPH_GLOBAL sph_index *start,
                                const SPH_GLOBAL sph_index *index)
{
    const sph_real gamma = SPH_R(5) / SPH_R(3);
    sph_density_options options;
    sph_density_out out;
    sph_index answer;
    int i;
    options.list_radius = sph_scalars_array(a + RADIUS * n);
    options.eta = SPH_R(1.2);
    options.tolerance = SPH_R(1e-4);
    out.h = a + H * n;
    out.rho = a + RHO * n;
    out.omega = a + OMEGA * n;
    out.stride = 1;
    out.status = 0;
    answer = sph_density_adaptive(VORTEX_KERNEL, 2, vortex_cloud(first, last, n, a, start, index),
                                  sph_scalars_array(a + M * n), options, out);
    for (i = first; i < last; i++) {
        const sph_real u = a[(NOW + U) * n + i], rho = a[RHO * n + i];
        sph_vec field;
        field.x = a[(NOW + BX) * n + i];
        field.y = a[(NOW + BY) * n + i];
        field.z = SPH_R(0);
        a[P * n + i] = (gamma - SPH_R(1)) * rho * u;
        a[CS * n + i] = SPHI_SQRT(gamma * (gamma - SPH_R(1)) * (u > SPH_R(0) ? u : SPH_R(0)));
        a[FAST * n + i] = sph_mhd_fast_speed(a[CS * n + i], field, rho, SPH_R(0));
    }
    return answer;
}
/* The rates of all that evolves. Returns how many overflowed. */
SPH_FN sph_index vortex_rates(int first, int last, int n, SPH_GLOBAL sph_real *a, const SPH_GLOBAL sph_index *start,
                              const SPH_GLOBAL sph_index *index, const SPH_GLOBAL sph_real *number)
{
    sph_mhd s;
    sph_mhd_out out;
    sph_index answer;
    int i;
    s.medium.m = sph_scalars_array(a + M * n);
    s.medium.rho = sph_scalars_array(a + RHO * n);
    s.medium.omega = sph_scalars_array(a + OMEGA * n);
    s.p = sph_scalars_array(a + P * n);
    s.u = sph_scalars_array(a + (NOW + U) * n);
    s.cs = sph_scalars_array(a + CS * n);
    s.alpha = sph_scalars_array(a + (NOW + ALPHA) * n);
    s.alpha_B = sph_scalars_same(number + NOTHING);
    s.v = sph_vectors_separate(a + (NOW + VX) * n, a + (NOW + VY) * n, 0);
    s.field = sph_vectors_separate(a + (NOW + BX) * n, a + (NOW + BY) * n, 0);
    s.psi = sph_scalars_array(a + (NOW + PSI) * n);
    s.ch = number[LARGEST_FAST];
    s.sigma = SPH_R(0.3);
    s.beta = SPH_R(2);
    s.alpha_u = s.tensile = SPH_R(1);
    out.acceleration = sph_vector_out_separate(a + (RATE + VX) * n, a + (RATE + VY) * n, 0);
    out.rate_B = sph_vector_out_separate(a + (RATE + BX) * n, a + (RATE + BY) * n, 0);
    out.rate_u = a + (RATE + U) * n;
    out.rate_psi = a + (RATE + PSI) * n;
    out.div_B = a + DIV_B * n;
    out.div_v = a + DIV_V * n;
    out.v_sig = a + SPEED * n;
    out.stride = 1;
    out.status = 0;
    answer = sph_mhd_rates(VORTEX_KERNEL, 2, vortex_cloud(first, last, n, a, start, index), s, out);
    for (i = first; i < last; i++) {
        const sph_real h = a[H * n + i], ax = a[(RATE + VX) * n + i], ay = a[(RATE + VY) * n + i], v = a[SPEED * n + i],
                       waves = (v > s.ch ? v : s.ch) / h, forces = SPHI_SQRT(SPHI_SQRT(ax * ax + ay * ay) / h) / SPH_R(0.8);
        sph_switch alpha;
        alpha.alpha = a[(NOW + ALPHA) * n + i];
        alpha.least = SPH_R(0.1);
        alpha.most = SPH_R(2);
        a[(RATE + ALPHA) * n + i] = sph_viscosity_switch_rate(alpha, v, h, a[DIV_V * n + i]);
        a[HASTE * n + i] = waves > forces ? waves : forces;
    }
    return answer;
}
/* The second half of a step: corrected by the trapezoidal rule. */
SPH_FN void vortex_correct(int first, int last, int n, SPH_GLOBAL sph_real *a, sph_real dt)
{
    int i, f;
    for (i = first; i < last; i++)
        for (f = 0; f < EVOLVED; f++)
            a[(NOW + f) * n + i] += SPH_R(0.5) * dt * (a[(RATE + f) * n + i] - a[(BEFORE + f) * n + i]);
}

#if SPH_OPENCL || defined(__CUDACC__)
DEVICE_KERNEL predict(int n, SPH_GLOBAL sph_real *a, const SPH_GLOBAL sph_real *number)
{
    const int i = DEVICE_ITEM;
    if (i < n) vortex_predict(i, i + 1, n, a, number);
}
DEVICE_KERNEL reach(int n, SPH_GLOBAL sph_real *a)
{
    const int i = DEVICE_ITEM;
    if (i < n) vortex_reach(i, i + 1, n, a);
}
/* number[which] is the largest of an array: one group of SCANNERS items */
DEVICE_KERNEL largest(int n, const SPH_GLOBAL sph_real *a, int array, SPH_GLOBAL sph_real *number, int which)
{
    DEVICE_SHARED sph_real part[SCANNERS];
    const int me = DEVICE_ITEM;
    sph_real most = a[array * n];
    int i;
    for (i = me; i < n; i += SCANNERS)
        if (a[array * n + i] > most) most = a[array * n + i];
    part[me] = most;
    DEVICE_TOGETHER;
    for (i = 0; me == 0 && i < SCANNERS; i++)
        if (part[i] > most) most = part[i];
    if (me == 0) number[which] = most;
}
DEVICE_KERNEL densities(int n, SPH_GLOBAL sph_real *a, const SPH_GLOBAL int *start, const SPH_GLOBAL int *index,
                        SPH_GLOBAL int *failed)
{
    const int i = DEVICE_ITEM;
    if (i < n && start[n] <= VORTEX_PAIRS * n && vortex_density(i, i + 1, n, a, start, index) != 0) DEVICE_NEXT(failed);
    if (i == 0 && start[n] > VORTEX_PAIRS * n) DEVICE_NEXT(failed); /* the lists have no room */
}
DEVICE_KERNEL rates(int n, SPH_GLOBAL sph_real *a, const SPH_GLOBAL int *start, const SPH_GLOBAL int *index,
                    const SPH_GLOBAL sph_real *number, SPH_GLOBAL int *failed)
{
    const int i = DEVICE_ITEM;
    if (i < n && start[n] <= VORTEX_PAIRS * n && vortex_rates(i, i + 1, n, a, start, index, number) != 0) DEVICE_NEXT(failed);
}
/* with the step that predict took: number has that of the next one later */
DEVICE_KERNEL correct(int n, SPH_GLOBAL sph_real *a, SPH_GLOBAL sph_real *number)
{
    const int i = DEVICE_ITEM;
    if (i < n) vortex_correct(i, i + 1, n, a, vortex_dt(number));
    if (i == 0) number[TIME] += vortex_dt(number);
}
#endif

#if !SPH_OPENCL
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LISTS, DENSITIES, RATES, STEP, STAGES };

/* The gas on the host, and what a host prints. */
typedef struct vortex {
    int n;
    sph_real *a, number[NUMBERS];
    sph_index *start, *index;
    void *work;
    int64_t pairs;
    double ns[STAGES]; /* so far */
} vortex;

static inline void *vortex_memory(size_t count, size_t size)
{
    void *const p = calloc(count, size);
    if (p) return p;
    puts("no memory");
    exit(1);
}
/* The beginning: a hexagonal lattice of `side` columns, with 512 of them as in the paper */
static inline vortex vortex_new(int side)
{
    const double pi = 3.14159265358979324, rho = 25 / (36 * pi), pressure = 5 / (12 * pi), B0 = 1 / sqrt(4 * pi);
    const int lines = 2 * (int)(side / sqrt(3.0)), n = side * lines;
    vortex g;
    int i;
    memset(&g, 0, sizeof g);
    g.n = n;
    g.a = (sph_real *)vortex_memory((size_t)ARRAYS * (size_t)n, sizeof *g.a);
    g.start = (sph_index *)vortex_memory((size_t)n + 1, sizeof *g.start);
    g.index = (sph_index *)vortex_memory((size_t)n * VORTEX_PAIRS, sizeof *g.index);
    g.work = vortex_memory(sph_grid_workspace(2, n), 1);
    g.number[COURANT] = SPH_R(0.3);
    for (i = 0; i < n; i++) {
        const double x = (i % side + 0.25 + 0.5 * (i / side & 1)) / side, y = (i / side + 0.5) / lines;
        g.a[X * n + i] = SPH_R(x);
        g.a[Y * n + i] = SPH_R(y);
        g.a[(NOW + VX) * n + i] = SPH_R(-sin(2 * pi * y));
        g.a[(NOW + VY) * n + i] = SPH_R(sin(2 * pi * x));
        g.a[(NOW + BX) * n + i] = SPH_R(-B0 * sin(2 * pi * y));
        g.a[(NOW + BY) * n + i] = SPH_R(B0 * sin(4 * pi * x));
        g.a[(NOW + U) * n + i] = SPH_R(pressure * 1.5 / rho);
        g.a[(NOW + ALPHA) * n + i] = SPH_R(0.1);
        g.a[M * n + i] = SPH_R(rho / n);
        g.a[H * n + i] = SPH_R(1.2 / sqrt(n));
    }
    return g;
}
static inline void vortex_free(vortex *g) { free(g->a), free(g->start), free(g->index), free(g->work); }
static inline sph_real vortex_largest(const vortex *g, int array)
{
    sph_real most = g->a[array * g->n];
    int i;
    for (i = 0; i < g->n; i++)
        if (g->a[array * g->n + i] > most) most = g->a[array * g->n + i];
    return most;
}
static inline double vortex_stage(vortex *g, int stage, double since)
{
    const double now = 1e9 * (double)clock() / CLOCKS_PER_SEC;
    g->ns[stage] += now - since;
    return now;
}
/* Lists, densities, rates. Returns 0 if all is well. */
static inline int vortex_evaluate(vortex *g)
{
    const sph_cloud all = vortex_cloud(0, g->n, g->n, g->a, g->start, g->index);
    const sph_scalars radius = sph_scalars_array(g->a + RADIUS * g->n);
    double at = vortex_stage(g, STEP, 1e9 * (double)clock() / CLOCKS_PER_SEC);
    sph_grid grid;
    vortex_reach(0, g->n, g->n, g->a);
    if (sph_grid_build(2, all.points, radius, g->work, sph_grid_workspace(2, g->n), &grid) ||
        sph_grid_lists(2, &grid, sph_query_of(all.points, SPH_LARGER, radius, 0), g->start, g->index,
                       (int64_t)g->n * VORTEX_PAIRS, &g->pairs))
        return puts("the host has no lists"), 1;
    at = vortex_stage(g, LISTS, at);
    if (vortex_density(0, g->n, g->n, g->a, g->start, g->index)) return puts("the host has no densities"), 1;
    at = vortex_stage(g, DENSITIES, at);
    g->number[LARGEST_FAST] = vortex_largest(g, FAST);
    if (vortex_rates(0, g->n, g->n, g->a, g->start, g->index, g->number)) return puts("the host has no rates"), 1;
    (void)vortex_stage(g, RATES, at);
    return 0;
}
static inline int vortex_run(vortex *g, int steps)
{
    int step;
    if (vortex_evaluate(g)) return 1;
    g->number[LARGEST_HASTE] = vortex_largest(g, HASTE);
    for (step = 0; step < steps; step++) {
        double at = 1e9 * (double)clock() / CLOCKS_PER_SEC;
        vortex_predict(0, g->n, g->n, g->a, g->number);
        (void)vortex_stage(g, STEP, at);
        if (vortex_evaluate(g)) return 1;
        at = 1e9 * (double)clock() / CLOCKS_PER_SEC;
        vortex_correct(0, g->n, g->n, g->a, vortex_dt(g->number));
        g->number[TIME] += vortex_dt(g->number);
        g->number[LARGEST_HASTE] = vortex_largest(g, HASTE);
        (void)vortex_stage(g, STEP, at);
    }
    return 0;
}
/* Bytes a particle that a stage must read and write at least: each array once, and each list entry once. */
static inline double vortex_bytes(int stage, double pairs)
{
    static const int reals[STAGES] = {6, 12, 36, 4 * EVOLVED + 8}, indices[STAGES] = {16, 2, 2, 0};
    return reals[stage] * (double)sizeof(sph_real) + indices[stage] * 4.0 + (stage == STEP ? 0.0 : 4.0 * pairs);
}
/* Prints how far the device's numbers are from the host's, after as many steps. bandwidth: bytes per ns of the
   device, 0 if it does not matter. Returns 1 if they differ by more than roundings. */
static inline int vortex_compare(const vortex *host, const vortex *device, const char *name, int steps, double bandwidth)
{
    static const char *const stage_name[STAGES] = {"lists", "densities with h", "rates", "step"};
    const double calls = steps + 1.0;
    const int n = host->n;
    double worst = 0;
    int k, i, lost = 0;
    for (k = 0; k < NOW + EVOLVED; k++) {
        double size = 0, off = 0;
        for (i = 0; i < n; i++) {
            const double d = fabs((double)host->a[k * n + i] - (double)device->a[k * n + i]);
            size = fmax(size, fabs((double)host->a[k * n + i]));
            off = fmax(off, d);
            lost += !(d <= 1e30); /* a NaN, too */
        }
        worst = fmax(worst, off / (size > 0 ? size : 1));
    }
    printf("%s, %s: %d particles, %d steps to t = %.4f and %.4f on the device; it differs by %.1e at most\n", name,
           SPH_SINGLE ? "float" : "double", n, steps, (double)host->number[TIME], (double)device->number[TIME], worst);
    if (bandwidth > 0) {
        printf("%-18s %14s %14s %10s %24s\n", "ns a particle", "the device", "one core", "ratio", "bound by its memory");
        for (k = 0; k < STAGES; k++)
            printf("%-18s %14.2f %14.1f %10.0f %24.2f\n", stage_name[k], device->ns[k] / (n * calls), host->ns[k] / (n * calls),
                   host->ns[k] / device->ns[k], vortex_bytes(k, (double)host->pairs / n) / bandwidth);
    }
    if (lost) printf("%d numbers are none\n", lost);
    /* terms of 1 / dx cancel in the sums of div B and of the forces, so that roundings grow with 1 / dx: they were
       20 to 100 epsilon / dx with 32 and with 512 columns */
    return lost || !(worst < 200 * (double)SPH_EPSILON * sqrt((double)n)) || !(device->number[TIME] > SPH_R(0));
}
#endif

#endif
