/* SPDX-License-Identifier: MIT */
/*
 * selfcheck.c - the toolkit checks itself on any machine, with static memory only: kernels against known answers, a neighbour search against all pairs, a corrected gradient of a
 * linear field, a small dam break. C99 and C++11.
 *
 *     cc -I. -I<where known_answers.h is> tests/embedded/selfcheck.c -lm        known_answers.h: see known.awk
 *
 *     -DSELFCHECK_KERNELS_ONLY=1    nothing but the kernels
 *     -DSELFCHECK_MAIN=name         a function instead of main, to link several of them
 * Ends with 'selfcheck: N passed, N failed'; the exit status is 0 if none failed.
 */
#include "sph.h"
#include "board.h"

#ifndef SELFCHECK_KERNELS_ONLY
#define SELFCHECK_KERNELS_ONLY 0
#endif

static long passed, failed;

static void text_of(long value) /* in decimal */
{
    char digits[24];
    int at = (int)sizeof digits - 1;
    unsigned long rest = value < 0 ? 0ul - (unsigned long)value : (unsigned long)value;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + (char)(rest % 10));
        rest /= 10;
    } while (rest);
    if (value < 0) digits[--at] = '-';
    board_text(digits + at);
}
/* prints what, and the value in units of 1/1000 */
static void report(const char *what, sph_real value)
{
    board_text("    ");
    board_text(what);
    board_text(": ");
    text_of((long)(value * SPH_R(1000) + SPH_R(0.5)));
    board_text("/1000\n");
}
static void check(const char *what, int holds)
{
    if (holds) {
        passed++;
        return;
    }
    if (failed++ >= 20) return; /* the rest is counted only */
    board_text("failed: ");
    board_text(what);
    board_text("\n");
}
static sph_real magnitude(sph_real x) { return x < SPH_R(0) ? -x : x; }

/* ---------------------------------------------------------------- kernels */

/* In units of SPH_EPSILON, of the largest value of each quantity; rounding allows for four (see tests/test_known_answers.c), and the C libraries of small machines have an exp that is
   a few more off. */
#define TOLERANCE (SPH_R(8) * SPH_EPSILON)

enum { W, DWDR, F, D2WDR2, DWDH, QUANTITIES };
typedef struct kernel_facts {
    unsigned char kernel, dim;
    sph_real sigma, largest[QUANTITIES]; /* for h = 1 */
} kernel_facts;
typedef struct known_answer {
    unsigned char kernel, dim;
    sph_real h, r, value[QUANTITIES];
} known_answer;

#define ANSWER(kernel, dim, h, r, w, dwdr, f, d2, dwdh)
#define KERNEL(kernel, dim, sigma, w, dwdr, f, d2, dwdh) \
    {(unsigned char)(kernel), dim, SPH_R(sigma), {SPH_R(w), SPH_R(dwdr), SPH_R(f), SPH_R(d2), SPH_R(dwdh)}},
static const BOARD_FLASH kernel_facts facts[] = {
#include "known_answers.h"
};
#undef ANSWER
#undef KERNEL
#define KERNEL(kernel, dim, sigma, w, dwdr, f, d2, dwdh)
#define ANSWER(kernel, dim, h, r, w, dwdr, f, d2, dwdh) \
    {(unsigned char)(kernel), dim, SPH_R(h), SPH_R(r), {SPH_R(w), SPH_R(dwdr), SPH_R(f), SPH_R(d2), SPH_R(dwdh)}},
static const BOARD_FLASH known_answer answers[] = {
#include "known_answers.h"
};
#undef ANSWER
#undef KERNEL

static void check_kernels(void)
{
    const int rows = (int)(sizeof answers / sizeof *answers), kernels = (int)(sizeof facts / sizeof *facts);
    sph_real worst = SPH_R(0);
    int i, q, of = 0;
    check("three dimensions of every kernel", kernels == 3 * (int)SPH_KERNEL_COUNT);
    for (i = 0; i < rows; i++) {
        const BOARD_FLASH known_answer *const a = &answers[i];
        const sph_kernel k = (sph_kernel)a->kernel;
        const int dim = a->dim;
        const sph_real r = a->r, h = a->h, power = dim == 1 ? h : dim == 2 ? h * h : h * h * h;
        const int outside = r >= h * sph_kernel_support_ratio(k);
        const char *const name = sph_kernel_name(k);
        sph_real got[QUANTITIES];
        got[W] = sph_kernel_w(k, dim, r, h);
        got[DWDR] = sph_kernel_dwdr(k, dim, r, h);
        got[F] = sph_kernel_f(k, dim, r, h);
        got[D2WDR2] = sph_kernel_d2wdr2(k, dim, r, h);
        got[DWDH] = sph_kernel_dwdh(k, dim, r, h);
        while (of < kernels - 1 && ((int)facts[of].kernel != (int)k || (int)facts[of].dim != dim)) of++; /* both in the same order */
        for (q = 0; q < QUANTITIES; q++) {
            const sph_real value = a->value[q], scale = q == W ? power : q == DWDR || q == DWDH ? power * h : power * h * h;
            const int relative = q == F && sph_kernel_has_cusp(k); /* F of a cusp grows like h/r */
            const sph_real size = relative ? magnitude(value) : facts[of].largest[q] / scale, off = magnitude(got[q] - value);
            check(name, off <= (outside ? SPH_R(0) : TOLERANCE * size));
            if (off > worst * SPH_EPSILON * size) worst = off / (SPH_EPSILON * size);
        }
        check(name, magnitude(sph_kernel_sigma(k, dim) - facts[of].sigma) <= SPH_EPSILON * facts[of].sigma);
    }
    report("kernels: farthest from a known answer, in units of round-off", worst);
}

/* ---------------------------------------------------------------- neighbours and gradients */

#if !SELFCHECK_KERNELS_ONLY

/* A column of water COLUMN particles wide and twice as high, in a tank three times as wide with walls two particles thick. */
enum {
    COLUMN = 5,
    WATER = 2 * COLUMN * COLUMN,
    TANK = 3 * COLUMN,
    WALL = 2,
    HEIGHT = 2 * COLUMN + 1,
    MOST = WATER + WALL * (TANK + 2 * WALL) + 2 * WALL * HEIGHT,
    ENTRIES = 33 * MOST / 2,
    WORK = (MOST + 18) * (3 * (int)sizeof(sph_real) + 3 * (int)sizeof(sph_index)) /* sph_grid_workspace, as a constant */
};
#define KERNEL SPH_WENDLAND_C2
#define SPACING (SPH_R(1) / SPH_R(COLUMN))

static sph_real x[MOST], y[MOST], vx[MOST], vy[MOST], rho[MOST], p[MOST], ax[MOST], ay[MOST];
#define field p /* one array for three: a particle's divergence is read before its pressure is written */
#define divergence p
static sph_index start[MOST + 1], list_index[ENTRIES];
static sph_real work[WORK / (int)sizeof(sph_real) + 1];
static int n;
static const sph_real length = SPH_R(1.3) * SPACING; /* smoothing length */

/* lists of all particles nearer than the support */
static int search(sph_points points)
{
    const sph_real radius = sph_kernel_support_ratio(KERNEL) * length;
    const sph_scalars R = sph_scalars_same(&radius);
    sph_grid grid;
    int64_t pairs = 0;
    return sph_grid_workspace(2, n) <= sizeof work && sph_grid_build(2, points, R, work, sizeof work, &grid) == 0 &&
           sph_grid_lists(2, &grid, sph_query_of(points, SPH_GATHER, R, SPH_LIST_SORTED), start, list_index, ENTRIES, &pairs) == 0;
}

/* a number in [0, 1), for positions off the lattice: Knuth's multiplicative hash */
static sph_real scatter(int i) { return (sph_real)(((uint32_t)i * 2654435761u) >> 16 & 0xffffu) / SPH_R(65536); }

static void check_cloud(void)
{
    const sph_points points = sph_points_separate((sph_index)MOST, x, y, 0);
    const sph_real radius = sph_kernel_support_ratio(KERNEL) * length, volume = SPACING * SPACING;
    const sph_list list = {start, list_index};
    const sph_cloud all = sph_cloud_of(points, list, sph_scalars_same(&length), sph_scalars_same(&volume));
    const sph_derivatives_out gradient = {ax, ay, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0};
    sph_real worst = SPH_R(0);
    int i, j;
    n = MOST;
    for (i = 0; i < n; i++) {
        x[i] = (SPH_R(i % 12) + SPH_R(0.3) * scatter(2 * i)) * SPACING;
        y[i] = (SPH_R(i / 12) + SPH_R(0.3) * scatter(2 * i + 1)) * SPACING;
        field[i] = SPH_R(1) + SPH_R(2) * x[i] - SPH_R(3) * y[i];
    }
    if (!search(points)) {
        check("neighbour search", 0);
        return;
    }
    for (i = 0; i < n; i++) {
        sph_index at = start[i];
        int same = 1;
        for (j = 0; j < n; j++) {
            const sph_real dx = x[i] - x[j], dy = y[i] - y[j], excess = (dx * dx + dy * dy) / (radius * radius) - SPH_R(1);
            const int listed = at < start[i + 1] && list_index[at] == (sph_index)j;
            at = (sph_index)(at + listed);
            /* on the radius itself rounding decides */
            if (magnitude(excess) > SPH_R(16) * SPH_EPSILON && listed != (j != i && excess < SPH_R(0))) same = 0;
        }
        check("the neighbours are those of all pairs", same && at == start[i + 1]);
    }
    check("corrected gradient", sph_gradient_cspm(KERNEL, 2, all, sph_scalars_array(field), gradient) == 0);
    for (i = 0; i < n; i++) {
        const sph_real ex = magnitude(ax[i] - SPH_R(2)), ey = magnitude(ay[i] + SPH_R(3)), e = ex > ey ? ex : ey;
        check("the corrected gradient of a linear field", e < SPH_R(300) * SPH_EPSILON);
        if (e > worst) worst = e;
    }
    report("corrected gradient: largest error, in units of round-off", worst / SPH_EPSILON);
}

/* ---------------------------------------------------------------- dam break */

/* Lengths in units of the column's width A, times of sqrt(A / g), density of water 1. Walls are particles that stand still and whose density obeys the same equation
   (Dalrymple & Knio 2001; Crespo, Gomez-Gesteira, Dalrymple 2007, CMC 5, 173). */
static const sph_real mass = SPACING * SPACING;
static const sph_tait water = {SPH_R(1), SPH_R(20), SPH_R(7), SPH_R(0)};

static void fill_tank(void)
{
    int i, j;
    n = 0;
    for (j = -(int)WALL; j < (int)HEIGHT; j++)
        for (i = -(int)WALL; i < (int)(TANK + WALL); i++)
            if (j < 0 || i < 0 || i >= (int)TANK) {
                x[WATER + n] = (SPH_R(i) + SPH_R(0.5)) * SPACING;
                y[WATER + n++] = (SPH_R(j) + SPH_R(0.5)) * SPACING;
            }
    for (j = 0; j < 2 * COLUMN; j++)
        for (i = 0; i < COLUMN; i++) {
            x[j * COLUMN + i] = (SPH_R(i) + SPH_R(0.5)) * SPACING;
            y[j * COLUMN + i] = (SPH_R(j) + SPH_R(0.5)) * SPACING;
        }
    n += WATER;
    for (i = 0; i < n; i++) {
        vx[i] = vy[i] = SPH_R(0);
        /* at rest under its weight */
        rho[i] = sph_density_tait(i < WATER ? SPH_R(2) - y[i] : SPH_R(0), water);
    }
}

/* the density, from continuity over the time dt; the pressure; the acceleration of the water */
static int tank_rates(sph_points points, sph_real dt)
{
    const sph_list list = {start, list_index};
    const sph_real one = SPH_R(1);
    const sph_cloud all = sph_cloud_of(points, list, sph_scalars_same(&length), sph_scalars_none());
    const sph_cloud targets = sph_cloud_range(all, 0, (sph_index)WATER);
    const sph_vector_out a = sph_vector_out_separate(ax, ay, 0);
    const sph_fluid_out out = {a, 0, 0, 0, 0};
    sph_fluid fluid;
    sph_medium gas;
    int i;
    fluid.m = gas.m = sph_scalars_same(&mass);
    fluid.rho = gas.rho = sph_scalars_array(rho);
    gas.omega = sph_scalars_same(&one);
    fluid.p = sph_scalars_array(p);
    fluid.c = sph_scalars_same(&water.c);
    fluid.v = sph_vectors_separate(vx, vy, 0);
    fluid.viscosity = SPH_VISCOSITY_MONAGHAN;
    fluid.alpha = SPH_R(0.1);
    fluid.beta = SPH_R(0);
    fluid.eta = SPH_R(0.1);
    if (!search(points) || sph_divergence_difference(KERNEL, 2, all, gas, fluid.v, sph_scalar_out_array(divergence, 0)) != 0) return 0;
    for (i = 0; i < n; i++) {
        rho[i] -= dt * rho[i] * divergence[i];
        p[i] = sph_pressure_tait(rho[i], water);
        if (i >= WATER && p[i] < SPH_R(0)) p[i] = SPH_R(0); /* a wall pushes, it does not pull */
    }
    return sph_fluid_rates_monaghan(KERNEL, 2, targets, fluid, out) == 0;
}

/* kinetic and potential, per mass of a particle */
static sph_real energy(void)
{
    sph_real sum = SPH_R(0);
    int i;
    for (i = 0; i < WATER; i++) sum += SPH_R(0.5) * (vx[i] * vx[i] + vy[i] * vy[i]) + y[i];
    return sum;
}

static void check_dam_break(void)
{
    const sph_points points = sph_points_separate((sph_index)MOST, x, y, 0);
    const sph_real dt = sph_time_step_sound(length, water.c, SPH_R(2)), end = SPH_R(1.2);
    sph_real t, before, after, front = SPH_R(0), top = SPH_R(0), lightest = SPH_R(1), heaviest = SPH_R(1);
    int i, well, inside = 1;
    fill_tank();
    check("as many particles as there is room for", n == MOST);
    before = energy();
    well = tank_rates(points, SPH_R(0));
    for (t = SPH_R(0); well && t < end; t += dt) { /* kick, drift, kick */
        for (i = 0; i < WATER; i++) {
            vx[i] += SPH_R(0.5) * dt * ax[i];
            vy[i] += SPH_R(0.5) * dt * (ay[i] - SPH_R(1));
            x[i] += dt * vx[i];
            y[i] += dt * vy[i];
        }
        well = tank_rates(points, dt);
        for (i = 0; i < WATER; i++) {
            vx[i] += SPH_R(0.5) * dt * ax[i];
            vy[i] += SPH_R(0.5) * dt * (ay[i] - SPH_R(1));
        }
    }
    check("every step of the dam break", well);
    for (i = 0; i < WATER; i++) {
        if (x[i] > front) front = x[i];
        if (y[i] > top) top = y[i];
        if (rho[i] < lightest) lightest = rho[i];
        if (rho[i] > heaviest) heaviest = rho[i];
        if (!(x[i] > SPH_R(0) && x[i] < SPH_R(TANK) * SPACING && y[i] > SPH_R(0) && y[i] < SPH_R(2))) inside = 0;
    }
    after = energy();
    report("dam break: front at t = 1.2", front + SPH_R(0.5) * SPACING);
    report("dam break: height of the column", top + SPH_R(0.5) * SPACING);
    report("dam break: lowest density", lightest);
    report("dam break: highest density", heaviest);
    report("dam break: energy left", after / before);
    check("the water stays in the tank", inside);
    check("the density stays within 3%", lightest > SPH_R(0.97) && heaviest < SPH_R(1.03));
    check("energy is dissipated, not made", after < before && after > SPH_R(0.8) * before);
    check("the front", front > SPH_R(1.6) && front < SPH_R(2.1));
    check("the column falls", top < SPH_R(1.9) && top > SPH_R(1));
}
#endif /* !SELFCHECK_KERNELS_ONLY */

#ifdef SELFCHECK_MAIN
#ifdef __cplusplus
extern "C"
#endif
    int
    SELFCHECK_MAIN(void);
#else
#define SELFCHECK_MAIN main
#endif
int SELFCHECK_MAIN(void)
{
    board_start();
    check_kernels();
#if !SELFCHECK_KERNELS_ONLY
    check_cloud();
    check_dam_break();
#endif
#ifdef BOARD_STACK
    board_text("stack: ");
    text_of(board_stack());
    board_text("\n");
#endif
    board_text("selfcheck: ");
    text_of(passed);
    board_text(" passed, ");
    text_of(failed);
    board_text(" failed\n");
    return board_end(failed != 0);
}
