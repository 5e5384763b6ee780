/* SPDX-License-Identifier: MIT */
/*
 * bench.c - times the neighbour search, beside other codes, and the operators. run.sh builds it and makes tables
 * of the lines that it prints:
 *
 *     search,PRECISION,N,CLOUD,ORDER,CODE,THREADS,NS_PER_PARTICLE,PAIRS,SPREAD
 *     sweep,PRECISION,N,CLOUD,ORDER,OPERATOR,FORM,THREADS,NS_PER_PARTICLE,PAIRS,SPREAD,BYTES_PER_PARTICLE
 *     limit,PRECISION,N,WHAT,VALUE
 *
 * Options: -n LIST, the numbers of particles; -rounds N; -only search, -only sweeps; -clouds LIST.
 *
 * One process holds the code that is compared in several forms, so that they are timed in turns. This file is
 * compiled once as the driver, with -DBENCH_FORMS="F(main) ..." -DBENCH_PEERS="P(nanoflann) ...", and once for
 * each form with -DBENCH_FORM=form_main and so on: -DBENCH_SEARCH=1 if the form has the search, -DBENCH_SWEEPS=N
 * if it has the first N operators.
 *
 * HOW IT MEASURES. All that is compared runs in turns, round after round; what is shorter than 5 ms is repeated.
 * A time is the shortest of all rounds: of the thread's CPU for one thread, of the clock for two. Spread is
 * (longest - shortest) / shortest. The search is one call of sph_search with memory that has been used before.
 *
 * CLOUDS, each in random order and sorted along a Z curve. The mean number of neighbours is near 57 where n is large:
 *     lattice    spacing 1, each coordinate moved by up to 0.2; radius 2.4
 *     periodic   the same in a periodic box
 *     surface    a layer 6 spacings deep, with every hundredth particle in drops up to 240 spacings above it
 *     plummer    Plummer's sphere within 6.3 of its radii: density contrast 10000; one radius for all
 *     plummer-h  the same; each particle has the radius of its own density: these differ by a factor of 22
 *     nested     half of the particles in such a sphere, half in another at its centre that is 45 times
 *                smaller; each particle has its own radius: these differ by a factor of about 1000
 *
 * Bytes that a sweep must move: each array that it reads or writes, once. A pair's index is one of 4 bytes.
 */
#if !defined(BENCH_FORM)
#define _POSIX_C_SOURCE 199309L
#endif

#include "sph.h"

#if defined(_OPENMP)
#include <omp.h>
#endif

/* ================================================================ what the parts share */

#define KERNEL SPH_WENDLAND_C2

/* Fields that a sweep reads are arrays of their own: one array in the place of several would be loaded once. */
enum { VX, VY, VZ, NX, NY, NZ, PSI, POSITIVE, RHO = POSITIVE, CS, U, ALPHA, ALPHA_B, OMEGA, H, FIELDS };
typedef struct cloud {
    const char *name, *order;
    sph_index n;
    sph_real *x, *y, *z, *radius, *V, *f;
    sph_real *more[FIELDS]; /* of the sweeps; null for the search */
    int each;     /* 1: one radius for each particle; 0: radius[0] for all */
    sph_real box; /* 0: open */
    sph_real h;
    sph_neighbors found;
    void *memory; /* of the search */
    size_t size;
} cloud;

/* macros, because #if compares them; the table of flags has the first five */
#define DENSITY 0
#define GRADIENT 1
#define FLUID 2
#define MHD_CLEANED 3
#define MSPH_ROWS 4
#define ACCELERATION 5
#define BROOKSHAW 6
#define BROOKSHAW_ROWS 7
#define APPLY 8
#define ICSPM 9
#define DENSITY_RATE 10
#define MOLTENI 11
#define ANTUONO 12
#define FREE_SURFACE 13
#define SHIFT 14
#define SHIFT_RATES 15
#define TRANSPORT 16
#define MORRIS 17
#define ESPANOL 18
#define RIEMANN 19
#define CSS 20
#define CSF 21
#define WALL 22
#define WALL_ROWS 23
#define FIT 24
#define PLAIN_GRADIENT 25
#define WALL_GRADIENT 26
#define FACTOR 27
#define GAS 28
#define GAS_OWN_H 29
#define OPERATORS 30
enum { OUTPUTS = 11 };
typedef struct outputs {
    sph_real *g[OUTPUTS], *row;
} outputs;

typedef struct form {
    const char *name;
    int has_search, sweeps; /* how many operators it has */
    sph_index (*search)(cloud *c, int threads);
    sph_index (*sweep)(int which, const cloud *c, const outputs *out, int threads);
    double (*reference)(sph_index n, const sph_real *r2, long passes); /* W + F of n values of r^2, `passes` times */
} form;

/* ================================================================ a form */

#if defined(BENCH_FORM)

#if !defined(BENCH_SEARCH)
#define BENCH_SEARCH 0
#endif
#if !defined(BENCH_SWEEPS)
#define BENCH_SWEEPS 0
#endif

static void use_threads(int threads)
{
#if defined(_OPENMP)
    omp_set_num_threads(threads);
#else
    (void)threads;
#endif
}
static sph_points points(const cloud *c)
{
    return sph_points_periodic(sph_points_separate(c->n, c->x, c->y, c->z), c->box, c->box, c->box);
}
static sph_index search(cloud *c, int threads)
{
    use_threads(threads);
#if BENCH_SEARCH
    return sph_search(3, points(c), sph_scalars_strided(c->radius, c->each), SPH_GATHER, c->memory, c->size, &c->found);
#else
    (void)c;
    return SPH_ERROR_VALUE;
#endif
}

static double reference(sph_index n, const sph_real *r2, long passes)
{
    static volatile sph_real smoothing = SPH_R(1.2); /* read in every pass, so that no pass is the last one's */
    double total = 0.0;
    long k;
    for (k = 0; k < passes; k++) {
        const sph_real h = smoothing;
        sph_real w = SPH_R(0), f = SPH_R(0);
        sph_index i;
        SPH_SUM(i, 0, n, w, f) {
            const sph_wf both = sph_kernel_wf(KERNEL, 3, SPHI_SQRT(r2[i]), h);
            w += both.w;
            f += both.f;
        }
        total += (double)w + (double)f;
    }
    return total;
}

static sph_vectors vectors_of(const cloud *c, int x)
{
    return sph_vectors_separate(c->more[x], c->more[x + 1], c->more[x + 2]);
}
#if BENCH_SWEEPS > FLUID
static sph_fluid fluid_of(const cloud *c, int viscosity)
{
    sph_fluid fluid;
    fluid.m = sph_scalars_array(c->V);
    fluid.rho = sph_scalars_array(c->more[RHO]);
    fluid.c = sph_scalars_array(c->more[CS]);
    fluid.p = sph_scalars_array(c->f);
    fluid.v = vectors_of(c, VX);
    fluid.alpha = fluid.eta = SPH_R(0.1);
    fluid.beta = SPH_R(0);
    fluid.viscosity = viscosity;
    return fluid;
}
#endif

#if BENCH_SWEEPS > APPLY
/* sum of row * (f_j - f_i): what a host does with rows it has stored */
static sph_index apply_rows(sph_index first, sph_index last, const cloud *c, const sph_real *row, sph_real *out)
{
    const sph_list list = c->found.list;
    sph_index i, p;
    for (i = first; i < last; i++) {
        const sph_real f_i = c->f[i];
        sph_real sum = SPH_R(0);
        SPH_SUM(p, list.start[i], list.start[i + 1], sum) sum += row[p] * (c->f[list.index[p]] - f_i);
        out[i] = sum;
    }
    return 0;
}
#endif

static sph_index sweep_range(int which, sph_index first, sph_index last, const cloud *c, const outputs *o)
{
    const sph_points x = sph_points_separate(c->n, c->x, c->y, c->z);
    const sph_scalars h = sph_scalars_same(&c->h), V = sph_scalars_array(c->V), f = sph_scalars_array(c->f);
    const sph_cloud targets = sph_cloud_range(sph_cloud_of(x, c->found.list, h, V), first, last);
    const sph_scalars rho = sph_scalars_array(c->more[RHO]), omega = sph_scalars_array(c->more[OMEGA]);
    const sph_vectors v = vectors_of(c, VX), n = vectors_of(c, NX);
    const sph_vector_out a = sph_vector_out_separate(o->g[0], o->g[1], o->g[2]);
    (void)f;
    (void)rho;
    (void)omega;
    (void)v;
    (void)n;
    (void)a;
    (void)targets;
    switch (which) {
#if BENCH_SWEEPS > DENSITY
    case DENSITY:
        return sph_density_summation(KERNEL, 3, targets, V, sph_scalar_out_array(o->g[0], 0));
#endif
#if BENCH_SWEEPS > GRADIENT
    case GRADIENT: {
        const sph_derivatives_out g = {.gx = o->g[0], .gy = o->g[1], .gz = o->g[2]};
        return sph_gradient_cspm(KERNEL, 3, targets, f, g);
    }
#endif
#if BENCH_SWEEPS > FLUID
    case FLUID: { /* with artificial viscosity, density rate and heating */
        const sph_fluid fluid = fluid_of(c, SPH_VISCOSITY_MONAGHAN);
        return sph_fluid_rates_monaghan(KERNEL, 3, targets, fluid,
                                        (sph_fluid_out){.acceleration = a, .rate = o->g[3], .heating = o->g[4]});
    }
#endif
#if BENCH_SWEEPS > MHD_CLEANED
    case MHD_CLEANED: {
        sph_mhd s;
        sph_mhd_out r = {0};
        s.medium.m = V;
        s.medium.rho = rho;
        s.medium.omega = omega;
        s.p = f;
        s.u = sph_scalars_array(c->more[U]);
        s.cs = sph_scalars_array(c->more[CS]);
        s.alpha = sph_scalars_array(c->more[ALPHA]);
        s.alpha_B = sph_scalars_array(c->more[ALPHA_B]);
        s.v = v;
        s.field = n;
        s.psi = sph_scalars_array(c->more[PSI]);
        s.ch = s.alpha_u = s.tensile = SPH_R(1);
        s.sigma = SPH_R(0.3);
        s.beta = SPH_R(2);
        r.acceleration = a;
        r.rate_B = sph_vector_out_separate(o->g[3], o->g[4], o->g[5]);
        r.rate_u = o->g[6];
        r.rate_psi = o->g[7];
        r.div_B = o->g[8];
        r.div_v = o->g[9];
        r.v_sig = o->g[10];
        return sph_mhd_rates(KERNEL, 3, targets, s, r);
    }
#endif
#if BENCH_SWEEPS > MSPH_ROWS
    case MSPH_ROWS: {
        const sph_rows_out r = {.row = o->row, .diagonal = o->g[0]};
        return sph_elliptic_rows_msph(KERNEL, 3, targets, V, (sph_elliptic_options){0}, r);
    }
#endif
#if BENCH_SWEEPS > ACCELERATION
    case ACCELERATION: { /* pressure alone */
        const sph_fluid fluid = fluid_of(c, SPH_VISCOSITY_NONE);
        return sph_fluid_rates_monaghan(KERNEL, 3, targets, fluid, (sph_fluid_out){.acceleration = a});
    }
#endif
#if BENCH_SWEEPS > BROOKSHAW
    case BROOKSHAW:
        return sph_laplacian_brookshaw(KERNEL, 3, targets, f, sph_scalar_out_array(o->g[0], 0));
#endif
#if BENCH_SWEEPS > BROOKSHAW_ROWS
    case BROOKSHAW_ROWS:
        return sph_laplacian_rows_brookshaw(KERNEL, 3, targets, (sph_rows_out){.row = o->row});
#endif
#if BENCH_SWEEPS > APPLY
    case APPLY:
        return apply_rows(first, last, c, o->row, o->g[0]);
#endif
#if BENCH_SWEEPS > ICSPM
    case ICSPM: {
        const sph_derivatives_out d = {o->g[0], o->g[1], o->g[2], o->g[3], o->g[4], o->g[5], o->g[6],
                                      o->g[7], o->g[8], o->g[9], 0,       1,       0};
        return sph_derivatives_icspm(KERNEL, 3, targets, f, (sph_derivatives_options){0}, d);
    }
#endif
#if BENCH_SWEEPS > TRANSPORT
    case DENSITY_RATE: {
        const sph_medium medium = {V, rho, omega};
        return sph_divergence_difference(KERNEL, 3, targets, medium, v, sph_scalar_out_array(o->g[0], 0));
    }
    case MOLTENI:
    case ANTUONO: { /* density rate with density diffusion */
        const sph_fluid fluid = fluid_of(c, SPH_VISCOSITY_NONE);
        const sph_diffusion d = {.fluid = fluid, .delta = SPH_R(0.1), .tait = {.c = SPH_R(10)}, .gradient = n};
        const sph_scalar_out rate = sph_scalar_out_array(o->g[0], 0);
        return which == MOLTENI ? sph_density_diffusion_molteni(KERNEL, 3, targets, d, rate)
                                : sph_density_diffusion_antuono(KERNEL, 3, targets, d, rate);
    }
    case FREE_SURFACE: /* div r, lambda, normal */
        return sph_free_surface(KERNEL, 3, targets,
                                (sph_surface_out){.divergence = o->g[3], .eigenvalue = o->g[4], .normal = a});
    case SHIFT: {
        const sph_shift s = {.strength = V, .tensile = SPH_R(0.2), .spacing = SPH_R(0.8)};
        return sph_shift_displacement(KERNEL, 3, targets, s, a);
    }
    case SHIFT_RATES:
    case TRANSPORT: {
        const sph_fluid fluid = fluid_of(c, SPH_VISCOSITY_NONE);
        if (which == SHIFT_RATES)
            return sph_shift_rates(KERNEL, 3, targets, fluid, n,
                                   (sph_fluid_out){.acceleration = a, .rate = o->g[3]});
        return sph_transport_adami(
            KERNEL, 3, targets, fluid, n, SPH_R(1),
            (sph_transport_out){a, sph_vector_out_separate(o->g[3], o->g[4], o->g[5]), 0});
    }
#endif
#if BENCH_SWEEPS > FACTOR
    case MORRIS:
    case ESPANOL:
    case RIEMANN: {
        const sph_fluid fluid = fluid_of(c, SPH_VISCOSITY_NONE);
        const sph_shear_bulk mu = {sph_scalars_array(c->more[ALPHA]), sph_scalars_array(c->more[ALPHA_B])};
        if (which == MORRIS) return sph_viscosity_mu_morris(KERNEL, 3, targets, fluid, mu.shear, a);
        if (which == ESPANOL) return sph_viscosity_mu_espanol_revenga(KERNEL, 3, targets, fluid, mu, a);
        return sph_fluid_rates_riemann(KERNEL, 3, targets, fluid, (sph_riemann_options){0},
                                       (sph_fluid_out){.acceleration = a, .rate = o->g[3], .heating = o->g[4]});
    }
    case CSS:
    case CSF: {
        const sph_tension t = {.rho = rho, .normal = n, .sigma = SPH_R(1)};
        return which == CSS ? sph_tension_css(KERNEL, 3, targets, t, a)
                            : sph_tension_csf(KERNEL, 3, targets, t, (sph_tension_out){.acceleration = a, .curvature = o->g[3]});
    }
    case WALL:
    case WALL_ROWS: {
        const sph_wall wall = {.share = V, .rho = rho, .p = f, .v = v, .velocity = n};
        if (which == WALL) return sph_wall_adami(KERNEL, 3, targets, wall, (sph_wall_out){.p = o->g[3], .v = a});
        return sph_wall_rows_adami(KERNEL, 3, targets, wall, (sph_rows_out){.row = o->row}, sph_scalar_out_array(o->g[0], 0));
    }
    case FIT:
        return sph_interpolate_mls(KERNEL, 3, targets, (sph_sources){x, V}, f, (sph_interpolation_options){0},
                                   (sph_interpolation_out){.value = o->g[3], .gx = o->g[0], .gy = o->g[1], .gz = o->g[2]});
    case PLAIN_GRADIENT:
        return sph_gradient_difference(KERNEL, 3, targets, f, a);
    case WALL_GRADIENT: {
        const sph_wall_terms wall = {.gamma = omega, .gradient = n, .value = sph_scalars_array(c->more[PSI])};
        return sph_wall_gradient(KERNEL, 3, targets, wall, f, a);
    }
    case FACTOR: {
        const sph_fluid fluid = fluid_of(c, SPH_VISCOSITY_NONE);
        return sph_pressure_factor_dfsph(KERNEL, 3, targets, fluid, sph_scalars_none(), sph_scalar_out_array(o->g[0], 0));
    }
#endif
#if BENCH_SWEEPS > GAS_OWN_H
    case GAS:
    case GAS_OWN_H: { /* with viscosity, Price's conductivity, du/dt, div v and the largest signal speed */
        const sph_gas gas = {.medium = {V, rho, omega}, .p = f, .u = sph_scalars_array(c->more[U]),
                             .cs = sph_scalars_array(c->more[CS]), .alpha = sph_scalars_array(c->more[ALPHA]),
                             .v = v, .beta = SPH_R(2), .alpha_u = SPH_R(1), .conductivity = SPH_CONDUCTIVITY_PRICE};
        const sph_gas_out r = {.acceleration = a, .rate_u = o->g[3], .div_v = o->g[4], .v_sig = o->g[5]};
        const sph_cloud own = sph_cloud_range(sph_cloud_of(x, c->found.list, sph_scalars_array(c->more[H]), V), first, last);
        return which == GAS ? sph_gas_rates(KERNEL, 3, targets, gas, r) : sph_gas_rates(KERNEL, 3, own, gas, r);
    }
#endif
    default:
        return SPH_ERROR_VALUE;
    }
}
static sph_index sweep(int which, const cloud *c, const outputs *o, int threads)
{
#if defined(_OPENMP)
    enum { CHUNK = 1024 };
    const sph_index chunks = (c->n + CHUNK - 1) / CHUNK;
    sph_index k, failed = 0;
#pragma omp parallel for schedule(dynamic) num_threads(threads) reduction(+ : failed)
    for (k = 0; k < chunks; k++)
        failed += sweep_range(which, k * CHUNK, k + 1 < chunks ? (k + 1) * CHUNK : c->n, c, o);
    return failed;
#else
    (void)threads;
    return sweep_range(which, 0, c->n, c, o);
#endif
}

extern const form BENCH_FORM;
const form BENCH_FORM = {
    SPH_AVX512 ? "avx512" : SPH_AVX2 ? "avx2" : "portable", BENCH_SEARCH, BENCH_SWEEPS, search, sweep, reference};

/* ================================================================ the driver */

#else

#include "examples/common/random.h"
#include "tests/bench/peer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define F(name) extern const form form_##name;
BENCH_FORMS
#undef F
#define P(name) extern const peer peer_##name;
BENCH_PEERS
#undef P
#define F(name) {#name, &form_##name},
static const struct {
    const char *name;
    const form *form;
} forms[] = {BENCH_FORMS};
#undef F
#define P(name) &peer_##name,
static const peer *const peers[] = {BENCH_PEERS 0};
#undef P
enum { FORMS = sizeof forms / sizeof *forms, PEERS = sizeof peers / sizeof *peers - 1 };
#define PRECISION (SPH_SINGLE ? "float" : "double")

/* what a sweep moves, beside positions and the list: arrays read, arrays written, and 1 if there is one number
   for each pair. Volumes are one of the arrays read. */
static const struct {
    const char *name;
    int in, out, row;
} operators[OPERATORS] = {{"density", 1, 1, 0},
                          {"corrected gradient", 2, 3, 0},
                          {"fluid rates", 7, 5, 0},
                          {"SPMHD with cleaning", 15, 11, 0},
                          {"M-SPH rows", 1, 1, 1},
                          {"acceleration by pressure", 3, 3, 0},
                          {"Brookshaw Laplacian", 2, 1, 0},
                          {"Brookshaw rows", 1, 0, 1},
                          {"apply stored rows", 1, 1, 1},
                          {"ICSPM derivatives", 2, 10, 0},
                          {"density rate", 6, 1, 0},
                          {"with Molteni's diffusion", 5, 1, 0},
                          {"with Antuono's diffusion", 8, 1, 0},
                          {"free surface", 1, 5, 0},
                          {"shift", 1, 3, 0},
                          {"rates of shifting", 9, 4, 0},
                          {"transport velocity", 9, 6, 0},
                          {"Morris's viscosity", 6, 3, 0},
                          {"Espanol & Revenga's viscosity", 7, 3, 0},
                          {"Riemann solver", 7, 5, 0},
                          {"tension by the stress", 5, 3, 0},
                          {"tension by the curvature", 5, 4, 0},
                          {"wall particles", 9, 4, 0},
                          {"rows of wall particles", 2, 1, 1},
                          {"linear fit", 2, 4, 0},
                          {"plain gradient", 2, 3, 0},
                          {"gradient with gamma", 7, 3, 0},
                          {"factor of DFSPH", 2, 1, 0},
                          {"gas rates", 10, 6, 0},
                          {"gas rates with its own h", 11, 6, 0}};

static void stop(const char *why, long code)
{
    fflush(stdout);
    fprintf(stderr, "bench: %s (%ld)\n", why, code);
    exit(1);
}
/* Every page is touched: the first use costs time that is not the toolkit's. Not with zeros: that and malloc are
   calloc to gcc, whose pages are all the same one, in the cache, until they are written. */
static void *memory(size_t bytes)
{
    void *const p = malloc(bytes ? bytes : 1);
    if (!p) stop("out of memory", 0);
    memset(p, 1, bytes);
    return p;
}
static sph_real *reals(sph_index n) { return (sph_real *)memory((size_t)n * sizeof(sph_real)); }

/* ---------------------------------------------------------------- particles */

typedef struct particle {
    double p[3], radius;
    uint64_t key;
} particle;

static int by_key(const void *a, const void *b)
{
    const uint64_t x = ((const particle *)a)->key, y = ((const particle *)b)->key;
    return (x > y) - (x < y);
}
/* the bits of three numbers of 21 bits, in turns */
static uint64_t z_curve(const particle *q, const double *low, double scale)
{
    uint64_t key = 0;
    int a, bit;
    for (a = 0; a < 3; a++) {
        const uint64_t cell = (uint64_t)((q->p[a] - low[a]) * scale);
        for (bit = 0; bit < 21; bit++) key |= (cell >> bit & 1) << (3 * bit + a);
    }
    return key;
}
/* n r_0^3 times the density, at the distance r from the centre of a Plummer sphere of radius r_0 that is cut */
#define CUT 6.3
static double plummer_most(void) { return pow(CUT * CUT / (1.0 + CUT * CUT), 1.5); }
static double plummer_density(double r)
{
    return r < CUT ? 0.238732414637843 / plummer_most() * pow(1.0 + r * r, -2.5) : 0.0;
}
static void plummer_place(pcg32 *g, double scale, double *p)
{
    const double u = pcg32_uniform(g), v = pcg32_uniform(g), w = pcg32_uniform(g);
    const double r = scale / sqrt(pow(u * plummer_most(), -2.0 / 3.0) - 1.0); /* (r^2 / (1 + r^2))^(3/2) lies within r */
    const double up = 1.0 - 2.0 * v, out = sqrt(1.0 - up * up);
    p[0] = r * out * cos(6.283185307179586 * w);
    p[1] = r * out * sin(6.283185307179586 * w);
    p[2] = r * up;
}

static const char *const cloud_names[] = {"lattice", "periodic", "surface", "plummer", "plummer-h", "nested"};
enum { LATTICE, PERIODIC, SURFACE, PLUMMER, PLUMMER_H, NESTED, CLOUDS };

static cloud cloud_new(int which, sph_index wanted, int sorted)
{
    const double ball = 4.18879020478639098, small = 45.0;
    const int side = (int)(cbrt((double)wanted) + 0.5);
    const sph_index n = which <= PERIODIC ? (sph_index)side * side * side : wanted, layer = n - n / 100;
    const int wide = (int)ceil(sqrt((double)layer / 6.0));
    particle *const q = (particle *)memory((size_t)n * sizeof *q);
    double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30}, size = 0.0;
    cloud c;
    pcg32 g;
    sph_index i;
    int a;
    memset(&c, 0, sizeof c);
    pcg32_seed(&g, 1, 1);
    for (i = 0; i < n; i++) {
        double *const p = q[i].p;
        q[i].radius = 2.4;
        if (which <= SURFACE) {
            const double u = pcg32_uniform(&g), v = pcg32_uniform(&g), w = pcg32_uniform(&g);
            const int s = which == SURFACE ? wide : side;
            p[0] = i % s + 0.4 * u;
            p[1] = i / s % s + 0.4 * v;
            p[2] = i / s / s + 0.4 * w;
            if (which == SURFACE && i >= layer) {
                p[0] = wide * u;
                p[1] = wide * v;
                p[2] = 6.0 + 240.0 * w;
            }
        } else {
            const double scale = which == NESTED && i % 2 ? 1.0 / small : 1.0;
            double r, density;
            plummer_place(&g, scale, p);
            r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            density = plummer_density(r);
            if (which == NESTED) density = 0.5 * (density + small * small * small * plummer_density(small * r));
            if (which == PLUMMER) density = 45.0 / 1024.0; /* the mean over its particles, without the cut */
            q[i].radius = cbrt(57.0 / (ball * n * density));
        }
        for (a = 0; a < 3; a++) {
            if (p[a] < low[a]) low[a] = p[a];
            if (p[a] > high[a]) high[a] = p[a];
            if (high[a] - low[a] > size) size = high[a] - low[a];
        }
    }
    for (i = 0; i < n; i++)
        q[i].key = sorted ? z_curve(q + i, low, 2097151.0 / size) : (uint64_t)pcg32_next(&g) << 32 | (uint64_t)i;
    qsort(q, (size_t)n, sizeof *q, by_key);

    c.name = cloud_names[which];
    c.order = sorted ? "sorted" : "random";
    c.n = n;
    c.each = which >= PLUMMER_H;
    c.box = which == PERIODIC ? SPH_R(side) : SPH_R(0);
    c.h = SPH_R(1.2);
    c.x = reals(n);
    c.y = reals(n);
    c.z = reals(n);
    c.radius = reals(n);
    c.V = reals(n);
    c.f = reals(n);
    for (i = 0; i < n; i++) {
        c.x[i] = SPH_R(q[i].p[0]);
        c.y[i] = SPH_R(q[i].p[1]);
        c.z[i] = SPH_R(q[i].p[2]);
        c.radius[i] = SPH_R(q[i].radius);
        c.V[i] = SPH_R(1);
        c.f[i] = SPH_R(sin(0.1 * q[i].p[0]) + 0.3 * q[i].p[1] * q[i].p[2] / side);
    }
    free(q);
    return c;
}
/* Smooth fields, alike in size and all different. */
static void cloud_fields(cloud *c)
{
    sph_index i;
    int k;
    for (k = 0; k < FIELDS; k++) {
        c->more[k] = reals(c->n);
        for (i = 0; i < c->n; i++) {
            const double wave = sin(0.1 * (double)c->x[i] + 0.07 * (double)c->y[i] + 0.13 * (double)c->z[i] + k);
            c->more[k][i] = k == H ? c->h : k < POSITIVE ? SPH_R(wave) : SPH_R(1.0 + 0.1 * wave);
        }
    }
}
/* One block for all forms, which may differ in pairs at the edge. */
static void cloud_search(cloud *c, const form *f)
{
    sph_index answer = f->search(c, 1);
    if (answer == SPH_ERROR_CAPACITY) {
        c->size = sph_search_size(3, c->n, c->found.pairs + c->found.pairs / 1000 + 16);
        c->memory = memory(c->size);
        answer = f->search(c, 1);
    }
    if (answer != 0) stop("sph_search", (long)answer);
}
static void cloud_free(cloud *c)
{
    int k;
    free(c->x);
    free(c->y);
    free(c->z);
    free(c->radius);
    free(c->V);
    free(c->f);
    for (k = 0; k < FIELDS; k++) free(c->more[k]);
    free(c->memory);
}

/* ---------------------------------------------------------------- tasks */

enum { SEARCH, PEER, SWEEP, REFERENCE, COPY };
enum { TASKS = 128, CACHED = 2048 };

typedef struct task {
    int kind, which, threads, calls;
    const char *what, *form_name;
    const form *form;
    const peer *peer;
    void *made;
    cloud *c;
    long long pairs;
    double least, most; /* seconds of one call */
} task;

static task tasks[TASKS];
static int task_count;
static outputs out;
static sph_real r2_cached[CACHED];
static double *copy_from, *copy_to;
enum { COPIED = 1 << 25 };
static volatile double sink;

static task *add(int kind, const char *what, int form_number, cloud *c, int threads)
{
    task *const t = tasks + task_count;
    if (task_count == TASKS) stop("too many tasks", TASKS);
    task_count++;
    memset(t, 0, sizeof *t);
    t->kind = kind;
    t->what = what;
    t->form_name = forms[form_number].name;
    t->form = forms[form_number].form;
    t->c = c;
    t->threads = threads;
    t->calls = 1;
    t->least = 1e30;
    return t;
}
static void copy_all(size_t n, const double *SPH_RESTRICT from, double *SPH_RESTRICT to)
{
    size_t i;
    for (i = 0; i < n; i++) to[i] = from[i];
}
static void (*volatile copy)(size_t n, const double *from, double *to) = copy_all; /* no compiler sees that it is not used */

static void perform(task *t)
{
    sph_index answer = 0;
    switch (t->kind) {
    case SEARCH:
        answer = t->form->search(t->c, t->threads);
        t->pairs = t->c->found.pairs;
        break;
    case PEER:
        t->pairs = t->peer->run(t->made);
        if (t->pairs < 0) stop(t->what, (long)t->pairs);
        break;
    case SWEEP:
        answer = t->form->sweep(t->which, t->c, &out, t->threads);
        break;
    case REFERENCE:
        sink = t->form->reference(CACHED, r2_cached, 100);
        break;
    default:
        copy(COPIED, copy_from, copy_to);
        sink = copy_to[12345];
    }
    if (answer < 0 || (t->c && answer > t->c->n / 100)) stop(t->what, (long)answer); /* ICSPM in float may find a few particles singular */
}
static double now(int threads)
{
    struct timespec t;
    clock_gettime(threads > 1 ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
static void run_tasks(int rounds)
{
    int r, k, i;
    for (r = -1; r < rounds; r++) /* the first round is a warm-up */
        for (k = 0; k < task_count; k++) {
            task *const t = tasks + k;
            const double begin = now(t->threads);
            double seconds;
            for (i = 0; i < t->calls; i++) perform(t);
            seconds = (now(t->threads) - begin) / t->calls;
            if (r < 0) {
                if (seconds < 5e-3) t->calls = (int)(5e-3 / (seconds + 1e-6)) + 1;
                continue;
            }
            if (seconds < t->least) t->least = seconds;
            if (seconds > t->most) t->most = seconds;
        }
}
static double spread(const task *t) { return t->most / t->least - 1.0; }

/* ---------------------------------------------------------------- what is measured */

static void bench_search(int which, sph_index n, int sorted, int rounds)
{
    cloud c = cloud_new(which, n, sorted);
    int k;
    task_count = 0;
    cloud_search(&c, forms[0].form);
    for (k = 0; k < FORMS; k++)
        if (forms[k].form->has_search) {
            const int threads = strcmp(forms[k].name, "threads") == 0;
            add(SEARCH, threads ? "OpenMP" : k ? forms[k].name : forms[k].form->name, k, &c, 1);
            if (threads) add(SEARCH, "OpenMP", k, &c, 2);
        }
    for (k = 0; k < PEERS && c.box == SPH_R(0); k++) {
        const peer_cloud same = {(size_t)c.n, c.x, c.y, c.z, c.radius, c.each};
        void *const made = peers[k]->make(&same);
        if (made) {
            task *const t = add(PEER, peers[k]->name, 0, &c, 1);
            t->peer = peers[k];
            t->made = made;
        }
    }
    run_tasks(rounds);
    for (k = 0; k < task_count; k++) {
        const task *const t = tasks + k;
        printf("search,%s,%ld,%s,%s,%s,%d,%.4g,%lld,%.3g\n", PRECISION, (long)c.n, c.name, c.order, t->what, t->threads,
               t->least * 1e9 / (double)c.n, t->pairs, spread(t));
        if (t->peer) t->peer->end(t->made);
    }
    printf("limit,%s,%ld,bytes of sph_search per particle (%s) without the lists,%.3g\n", PRECISION, (long)c.n, c.name,
           ((double)sph_search_size(3, c.n, 0) - (double)(c.n + 1) * (double)sizeof(sph_index)) / (double)c.n);
    cloud_free(&c);
    fflush(stdout);
}

static void bench_sweeps(sph_index n, int rounds)
{
    cloud c[2];
    pcg32 g;
    const task *reference, *copied;
    int k, o, i;
    task_count = 0;
    pcg32_seed(&g, 3, 1);
    for (i = 0; i < CACHED; i++) {
        const double q = 2.4 * cbrt(pcg32_uniform(&g));
        r2_cached[i] = SPH_R(q * q);
    }
    copy_from = (double *)memory(COPIED * sizeof *copy_from);
    copy_to = (double *)memory(COPIED * sizeof *copy_to);
    for (k = 0; k < 2; k++) {
        c[k] = cloud_new(LATTICE, n, !k);
        cloud_fields(c + k);
        cloud_search(c + k, forms[0].form);
    }
    for (k = 0; k < OUTPUTS; k++) out.g[k] = reals(c[0].n);
    out.row = (sph_real *)memory((size_t)c[0].found.pairs * sizeof *out.row);
    reference = add(REFERENCE, "W + F", 0, 0, 1);
    copied = add(COPY, "copy", 0, 0, 1);
    for (k = 0; k < FORMS; k++)
        for (o = 0; o < forms[k].form->sweeps; o++) {
            const int both = strcmp(forms[k].name, "threads") == 0;
            add(SWEEP, operators[o].name, k, c, 1)->which = o;
            if (both) add(SWEEP, operators[o].name, k, c, 2)->which = o;
            if (!k) add(SWEEP, operators[o].name, k, c + 1, 1)->which = o;
        }
    run_tasks(rounds);
    printf("limit,%s,%ld,ns of one W + F,%.4g\n", PRECISION, (long)c[0].n, reference->least * 1e9 / (100.0 * CACHED));
    printf("limit,%s,%ld,GB/s of a copy,%.4g\n", PRECISION, (long)c[0].n, 2e-9 * COPIED * sizeof *copy_to / copied->least);
    for (k = 2; k < task_count; k++) {
        const task *const t = tasks + k;
        const double bytes =
            (double)sizeof(sph_real) * ((double)t->c->n * (3 + operators[t->which].in + operators[t->which].out) +
                                        (double)t->c->found.pairs * operators[t->which].row) +
            (double)sizeof(sph_index) * (double)(t->c->n + 1 + t->c->found.pairs);
        printf("sweep,%s,%ld,%s,%s,%s,%s,%d,%.4g,%lld,%.3g,%.4g\n", PRECISION, (long)t->c->n, t->c->name, t->c->order, t->what,
               t->form_name, t->threads, t->least * 1e9 / (double)t->c->n, (long long)t->c->found.pairs, spread(t),
               bytes / (double)t->c->n);
    }
    for (k = 0; k < OUTPUTS; k++) free(out.g[k]);
    free(out.row);
    free(copy_from);
    free(copy_to);
    for (k = 0; k < 2; k++) cloud_free(c + k);
    fflush(stdout);
}

static int listed(const char *list, const char *name) /* names, with commas between them */
{
    const size_t length = strlen(name);
    for (; list; list = strchr(list, ','), list += list != 0)
        if (strncmp(list, name, length) == 0 && (list[length] == ',' || !list[length])) return 1;
    return 0;
}

int main(int argc, char **argv)
{
    const char *sizes = "1e5", *only = "", *clouds = "lattice,periodic,surface,plummer,plummer-h,nested";
    int rounds = 5, k;
    for (k = 1; k < argc; k++) {
        const char *const value = k + 1 < argc ? argv[k + 1] : "";
        if (strcmp(argv[k], "-n") == 0) sizes = value, k++;
        else if (strcmp(argv[k], "-rounds") == 0) rounds = atoi(value), k++;
        else if (strcmp(argv[k], "-only") == 0) only = value, k++;
        else if (strcmp(argv[k], "-clouds") == 0) clouds = value, k++;
        else stop("usage: bench [-n 1e4,1e5,...] [-rounds N] [-only search|sweeps] [-clouds lattice,nested,...]", 0);
    }
    if (rounds < 1) stop("-rounds: 1 or more", rounds);
    while (*sizes) {
        char *end;
        const double n = strtod(sizes, &end);
        if (end == sizes || !(n >= 1000.0) || n > 3e7) stop("-n: numbers between 1e3 and 3e7, separated by commas", 0);
        sizes = *end == ',' ? end + 1 : end;
        if (strcmp(only, "sweeps") != 0)
            for (k = 0; k < CLOUDS; k++) {
                if (!listed(clouds, cloud_names[k])) continue;
                bench_search(k, (sph_index)n, 1, rounds);
                bench_search(k, (sph_index)n, 0, rounds);
            }
        if (strcmp(only, "search") != 0) bench_sweeps((sph_index)n, rounds);
    }
    return 0;
}

#endif
