/* SPDX-License-Identifier: MIT */
/*
 * bench.c - times the neighbour search and the operators. run.sh builds and runs it in several variants; it can be run alone:
 *
 *     bench -name "gcc -O2" -n 1e4,1e5,1e6 -dim 3 -csv bench.csv -targets targets.csv
 *         -brief: at large n the lists only    -full: more rounds, and everything at every n
 *
 * One process holds the code that is compared in several forms, so that they are timed in turns: this file is compiled once without BENCH_SEARCH and BENCH_OPS
 * (the driver), and once per form with the table of functions that the form exports:
 *     -DBENCH_SEARCH=search_main      the search as the variant's flags make it
 *     -DBENCH_SEARCH=search_portable  with -DSPH_AVX512=0 -DSPH_AVX2=0 (tell the driver: -DHAVE_PORTABLE)
 *     -DBENCH_SEARCH=search_avx2      with -DSPH_AVX512=0 (-DHAVE_AVX2)
 *     -DBENCH_SEARCH=search_omp       with -fopenmp -DSPH_OPENMP=1 (-DHAVE_OPENMP)
 *     -DBENCH_OPS=ops_main            with -DSPH_CHECK=0
 *     -DBENCH_OPS=ops_checked         with -DSPH_CHECK=1
 *     -DBENCH_OPS=ops_omp             with -fopenmp -DSPH_CHECK=0 (-DHAVE_OPENMP): ranges of targets in a parallel loop of this file
 *     nanoflann.cpp                   (-DHAVE_NANOFLANN)
 * A form is for 3D and one radius for all; -DBENCH_2D=1 adds 2D, -DBENCH_VARIABLE=1 one radius for each (tell the driver: -DHAVE_VARIABLE). Each call
 * takes seconds to compile.
 *
 * HOW IT MEASURES. Particles: a lattice of spacing 1, each coordinate moved by up to 0.2, stored along the rows of the lattice ("lattice") or shuffled
 * ("random"); h = 1.2, radius 2.4. All things of one n are timed in turns, round after round; before and after each the reference is timed, one W + F from r^2
 * with r^2 in cache, which says how fast the core is at that moment. Times are medians over the rounds; ratios are taken within a round, and then their median.
 * Spread is (largest - smallest) / median of the time. "Flat" compares time per interaction over that of the reference, because in small clouds, with more
 * surface, particles have fewer neighbours. An interaction is an entry of the lists: i with j, and j with i.
 * "surface" and "galaxy" are clouds most of whose cells are empty: see cloud_sparse. They are timed at n near 1e5, in 3D.
 * "+ permuting x, y, z" is for a host that sorts: grid, its three coordinates into cell order, lists of the sorted particles; random order is judged by it.
 */
#if !defined(BENCH_SEARCH) && !defined(BENCH_OPS)
#define _POSIX_C_SOURCE 199309L
#endif

#include "sph.h"

#if defined(_OPENMP) && (defined(BENCH_SEARCH) || defined(BENCH_OPS))
#include <omp.h>
#endif

/* ================================================================ what the parts share */

#define KERNEL SPH_WENDLAND_C2
#if !defined(BENCH_2D)
#define BENCH_2D 0
#endif
#if !defined(BENCH_VARIABLE)
#define BENCH_VARIABLE 0
#endif

typedef struct cloud {
    int dim, side;
    sph_index n;
    sph_real *x, *y, *z, *V, *f;
    sph_real h, radius;
    sph_real *own_radius; /* null: all have `radius` */
    sph_real box;         /* 0: open */
    const char *storage; /* how the particles lie, and in which order */
    sph_index *start, *index;
    int64_t pairs, capacity;
} cloud;

typedef struct search {
    const char *path;
    size_t (*workspace)(int dim, sph_index n);
    sph_index (*build)(const cloud *c, void *work, size_t work_size, int threads);
    sph_index (*sort)(const cloud *c, cloud *sorted); /* after build: the positions in cell order, and the grid of these */
    sph_index (*lists)(cloud *c, int count_only, int threads);
} search;

/* those from ICSPM on take long to compile and are in the main form only: their checks and their ranges are like those of the others */
enum { DENSITY, GRADIENT, BROOKSHAW, ROWS, APPLY, ICSPM, ACCELERATION, FLUID, MSPH_ROWS, MHD, MHD_CLEANED, OPERATORS };
enum { OUTPUTS = 11 };
typedef struct outputs {
    sph_real *g[OUTPUTS], *row;
} outputs;
typedef struct ops {
    sph_index (*apply)(int which, const cloud *c, const outputs *out, int threads);
    double (*reference)(sph_index n, const sph_real *r2, long passes);         /* W + F of n values of r^2, `passes` times: the sum */
    double (*spin)(sph_index n, const sph_real *r2, long passes, int threads); /* the same twice, by one thread or by two */
} ops;

/* ================================================================ a form of the search */

#if defined(BENCH_SEARCH)

static sph_grid grid;

static sph_points points(const cloud *c)
{
    const sph_points p = sph_points_separate(c->n, c->x, c->y, c->z);
    return sph_points_periodic(p, c->box, c->box, c->box);
}
static void use_threads(int threads)
{
#if defined(_OPENMP)
    omp_set_num_threads(threads);
#else
    (void)threads;
#endif
}
static size_t workspace(int dim, sph_index n) { return sph_grid_workspace(dim, n); }

static sph_index build(const cloud *c, void *work, size_t work_size, int threads)
{
    use_threads(threads);
#if BENCH_2D
    if (c->dim == 2) return sph_grid_build(2, points(c), c->radius, work, work_size, &grid);
#endif
    return c->dim == 3 ? sph_grid_build(3, points(c), c->radius, work, work_size, &grid) : SPH_ERROR_DIM;
}

static sph_index sort(const cloud *c, cloud *sorted)
{
    const sph_index *const order = sph_grid_permutation(&grid);
    const sph_index failed = sph_permute(c->n, order, c->x, 1, sorted->x) | sph_permute(c->n, order, c->y, 1, sorted->y) |
                             (c->dim > 2 ? sph_permute(c->n, order, c->z, 1, sorted->z) : 0);
    return failed ? failed : sph_grid_renumber(&grid);
}

/* Criterion and dimension are constants here, as a host would write them. */
static sph_index lists(cloud *c, int count_only, int threads)
{
    use_threads(threads);
#define LISTS(dim, criterion) \
    (count_only ? sph_grid_count(dim, &grid, sph_query_of(points(c), criterion, R, 0), c->start, &c->pairs) \
                : sph_grid_lists(dim, &grid, sph_query_of(points(c), criterion, R, 0), c->start, c->index, c->capacity, &c->pairs))
    if (c->own_radius) {
#if BENCH_VARIABLE
        const sph_scalars R = sph_scalars_array(c->own_radius);
        if (c->dim == 3) return LISTS(3, SPH_LARGER);
#endif
    } else {
        const sph_scalars R = sph_scalars_same(&c->radius);
#if BENCH_2D
        if (c->dim == 2) return LISTS(2, SPH_GATHER);
#endif
        if (c->dim == 3) return LISTS(3, SPH_GATHER);
    }
    return SPH_ERROR_DIM; /* not built */
}

extern const search BENCH_SEARCH;
const search BENCH_SEARCH = {SPH_AVX512 ? "avx512" : SPH_AVX2 ? "avx2" : "portable", workspace, build, sort, lists};

/* ================================================================ a form of the operators */

#elif defined(BENCH_OPS)

#if SPH_SINGLE
#define ROOT(x) sqrtf(x)
#else
#define ROOT(x) sqrt(x)
#endif

static double reference(sph_index n, const sph_real *r2, long passes)
{
    static volatile sph_real smoothing = SPH_R(1.2); /* read in every pass, so that no pass is the last one's */
    double total = 0.0;
    long k;
    for (k = 0; k < passes; k++) {
        const sph_real h = smoothing;
        sph_real w = SPH_R(0), f = SPH_R(0);
        sph_index i;
        SPH_SUM(w, f)
        for (i = 0; i < n; i++) {
            const sph_wf both = sph_kernel_wf(KERNEL, 3, ROOT(r2[i]), h);
            w += both.w;
            f += both.f;
        }
        total += (double)w + (double)f;
    }
    return total;
}

/* sum of row * (f_j - f_i): what a host does with rows it has stored */
static sph_index apply_rows(sph_index first, sph_index last, const cloud *c, const sph_real *row, sph_real *out)
{
    sph_index i, p;
    for (i = first; i < last; i++) {
        const sph_real f_i = c->f[i];
        sph_real sum = SPH_R(0);
        SPH_SUM(sum)
        for (p = c->start[i]; p < c->start[i + 1]; p++) sum += row[p] * (c->f[c->index[p]] - f_i);
        out[i] = sum;
    }
    return 0;
}

/* dim is a constant where this is called, so that the operators see one */
SPH_FN sph_index apply_range(int which, int dim, sph_index first, sph_index last, const cloud *c, const outputs *o)
{
    const sph_points x = sph_points_separate(c->n, c->x, c->y, c->z);
    const sph_scalars h = sph_scalars_same(&c->h), V = sph_scalars_array(c->V), f = sph_scalars_array(c->f);
    const sph_list list = {c->start, c->index};
    const sph_cloud targets = sph_cloud_range(sph_cloud_of(x, list, h, V), first, last);
    switch (which) {
    case DENSITY:
        return sph_density_summation(KERNEL, dim, targets, V, sph_scalar_out_array(o->g[0], 0));
    case GRADIENT: {
        const sph_derivatives_out g = {.gx = o->g[0], .gy = o->g[1], .gz = o->g[2]};
        return sph_gradient_cspm(KERNEL, dim, targets, f, g);
    }
    case BROOKSHAW:
        return sph_laplacian_brookshaw(KERNEL, dim, targets, f, sph_scalar_out_array(o->g[0], 0));
    case ROWS:
        return sph_laplacian_rows_brookshaw(KERNEL, dim, targets, (sph_rows_out){.row = o->row});
    case APPLY:
        return apply_rows(first, last, c, o->row, o->g[0]);
#if !SPH_CHECK && !defined(_OPENMP)
    case ICSPM: {
        const sph_derivatives_out d = {o->g[0], o->g[1], o->g[2], o->g[3], o->g[4], o->g[5], o->g[6],
                                      o->g[7], o->g[8], o->g[9], 0,       1,       0};
        return sph_derivatives_icspm(KERNEL, dim, targets, f, (sph_derivatives_options){0}, d);
    }
    case ACCELERATION: /* pressure alone */
    case FLUID: {      /* with artificial viscosity, density rate and heating */
        const sph_vector_out a = sph_vector_out_separate(o->g[0], o->g[1], o->g[2]);
        sph_fluid fluid;
        fluid.m = fluid.rho = fluid.c = V;
        fluid.p = fluid.v.x = fluid.v.y = fluid.v.z = f;
        fluid.alpha = fluid.eta = SPH_R(0.1);
        fluid.beta = SPH_R(0);
        fluid.viscosity = SPH_VISCOSITY_NONE;
        if (which == ACCELERATION) return sph_fluid_rates_monaghan(KERNEL, dim, targets, fluid, (sph_fluid_out){.acceleration = a});
        fluid.viscosity = SPH_VISCOSITY_MONAGHAN;
        return sph_fluid_rates_monaghan(KERNEL, dim, targets, fluid, (sph_fluid_out){.acceleration = a, .rate = o->g[3], .heating = o->g[4]});
    }
    case MSPH_ROWS: {
        const sph_rows_out r = {.row = o->row, .diagonal = o->g[0]};
        return sph_elliptic_rows_msph(KERNEL, dim, targets, V, (sph_elliptic_options){0}, r);
    }
    case MHD: /* as many components as dimensions */
    case MHD_CLEANED: {
        sph_mhd s;
        sph_mhd_out r = {0};
        s.medium.m = s.medium.rho = s.medium.omega = s.p = s.u = s.cs = s.alpha = s.alpha_B = V;
        s.v = s.field = sph_vectors_separate(c->f, c->f, dim > 2 ? c->f : 0);
        s.psi = sph_scalars_none();
        s.ch = s.alpha_u = s.tensile = SPH_R(1);
        s.sigma = SPH_R(0.3);
        s.beta = SPH_R(2);
        r.acceleration = sph_vector_out_separate(o->g[0], o->g[1], o->g[2]);
        r.rate_B = sph_vector_out_separate(o->g[3], o->g[4], o->g[5]);
        r.rate_u = o->g[6];
        r.rate_psi = o->g[7];
        r.div_B = o->g[8];
        r.div_v = o->g[9];
        r.v_sig = o->g[10];
        if (which == MHD) return sph_mhd_rates(KERNEL, dim, targets, s, r);
        s.psi = f;
        return sph_mhd_rates(KERNEL, dim, targets, s, r);
    }
#endif
    default:
        return SPH_ERROR_VALUE;
    }
}
static sph_index apply_some(int which, sph_index first, sph_index last, const cloud *c, const outputs *o)
{
#if BENCH_2D
    if (c->dim == 2) return apply_range(which, 2, first, last, c, o);
#endif
    return c->dim == 3 ? apply_range(which, 3, first, last, c, o) : SPH_ERROR_DIM;
}

static sph_index apply(int which, const cloud *c, const outputs *o, int threads)
{
#if defined(_OPENMP)
    enum { CHUNK = 1024 };
    const sph_index chunks = (c->n + CHUNK - 1) / CHUNK;
    sph_index k, failed = 0;
#pragma omp parallel for schedule(dynamic) num_threads(threads) reduction(+ : failed)
    for (k = 0; k < chunks; k++) failed += apply_some(which, k * CHUNK, k + 1 < chunks ? (k + 1) * CHUNK : c->n, c, o);
    return failed;
#else
    (void)threads;
    return apply_some(which, 0, c->n, c, o);
#endif
}

static double spin(sph_index n, const sph_real *r2, long passes, int threads)
{
    double total = 0.0;
    int k;
    (void)threads;
#if defined(_OPENMP)
#pragma omp parallel for schedule(dynamic) num_threads(threads) reduction(+ : total)
#endif
    for (k = 0; k < 2; k++) total += reference(n, r2, passes);
    return total;
}

extern const ops BENCH_OPS;
const ops BENCH_OPS = {apply, reference, spin};

/* ================================================================ the driver */

#else

#include "examples/common/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

extern const search search_main, search_portable, search_avx2, search_omp;
extern const ops ops_main, ops_checked, ops_omp;
long long nanoflann_double(int dim, size_t n, const double *x, const double *y, const double *z, double radius);
long long nanoflann_float(int dim, size_t n, const float *x, const float *y, const float *z, float radius);

#if !defined(HAVE_NANOFLANN)
#define HAVE_NANOFLANN 0
#endif
#if !defined(HAVE_OPENMP)
#define HAVE_OPENMP 0
#endif
#if !defined(HAVE_PORTABLE)
#define HAVE_PORTABLE 0
#endif
#if !defined(HAVE_VARIABLE)
#define HAVE_VARIABLE 0
#endif
#if !defined(HAVE_AVX2)
#define HAVE_AVX2 0
#endif
#if SPH_SINGLE
#define PRECISION "float"
#else
#define PRECISION "double"
#endif

static void stop(const char *why, long code)
{
    fflush(stdout);
    fprintf(stderr, "bench: %s (%ld)\n", why, code);
    exit(1);
}
static void *memory(size_t bytes) /* every page is touched: the first use costs time that is not the toolkit's */
{
    void *const p = malloc(bytes ? bytes : 1);
    if (!p) stop("out of memory", 0);
    memset(p, 0, bytes);
    return p;
}
static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}
static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}
static double median(int n, const double *v)
{
    double s[64];
    memcpy(s, v, (size_t)n * sizeof *s);
    qsort(s, (size_t)n, sizeof *s, ascending);
    return n % 2 ? s[n / 2] : 0.5 * (s[n / 2 - 1] + s[n / 2]);
}

/* ---------------------------------------------------------------- the reference */

enum { CACHED = 2048 };
static sph_real r2_cached[CACHED];
static long reference_passes = 1;
static volatile double sink;

/* ns per W + F; about a millisecond */
static double reference_time(void)
{
    const double t = now();
    sink = ops_main.reference(CACHED, r2_cached, reference_passes);
    return (now() - t) * 1e9 / ((double)CACHED * (double)reference_passes);
}
static double reference_start(void)
{
    pcg32 g;
    double t[15];
    int i;
    pcg32_seed(&g, 3, 1);
    for (i = 0; i < CACHED; i++) {
        const double q = 2.4 * cbrt(pcg32_uniform(&g));
        r2_cached[i] = SPH_R(q * q);
    }
    for (i = 0; i < 3; i++) {
        reference_passes = (long)(1e6 / (reference_time() * CACHED));
        if (reference_passes < 1) reference_passes = 1;
    }
    for (i = 0; i < 15; i++) t[i] = reference_time();
    return median(15, t);
}

static void copy_all(size_t n, const double *SPH_RESTRICT from, double *SPH_RESTRICT to)
{
    size_t i;
    for (i = 0; i < n; i++) to[i] = from[i];
}
static void (*volatile copy)(size_t n, const double *from, double *to) = copy_all; /* so that no compiler sees that the copy is not used */

/* GB/s of a[i] = b[i], both directions counted, in memory that no cache holds */
static double copy_bandwidth(void)
{
    const size_t n = (size_t)1 << 25;
    double *const a = (double *)memory(n * sizeof *a), *const b = (double *)memory(n * sizeof *b), t[5];
    int i;
    for (i = 0; i < 5; i++) {
        const double begin = now();
        copy(n, a, b);
        t[i] = 2.0 * (double)(n * sizeof *a) / (now() - begin) * 1e-9;
        sink = b[(size_t)i * 1000];
    }
    free(a);
    free(b);
    return median(5, t);
}

/* ---------------------------------------------------------------- particles */

static cloud cloud_new(int dim, int side, int shuffled)
{
    cloud c;
    pcg32 g;
    sph_index i, *to;
    memset(&c, 0, sizeof c);
    c.dim = dim;
    c.side = side;
    c.n = (sph_index)(dim == 2 ? (int64_t)side * side : (int64_t)side * side * side);
    c.h = SPH_R(1.2);
    c.radius = SPH_R(2.4);
    c.storage = shuffled ? "random" : "lattice";
    c.x = (sph_real *)memory((size_t)c.n * sizeof *c.x);
    c.y = (sph_real *)memory((size_t)c.n * sizeof *c.y);
    c.z = (sph_real *)memory((size_t)c.n * sizeof *c.z);
    c.V = (sph_real *)memory((size_t)c.n * sizeof *c.V);
    c.f = (sph_real *)memory((size_t)c.n * sizeof *c.f);
    c.start = (sph_index *)memory(((size_t)c.n + 1) * sizeof *c.start);
    to = (sph_index *)memory((size_t)c.n * sizeof *to);
    for (i = 0; i < c.n; i++) to[i] = i;
    pcg32_seed(&g, 2, 1);
    if (shuffled)
        for (i = c.n - 1; i > 0; i--) {
            const sph_index k = (sph_index)(pcg32_uniform(&g) * (i + 1)), t = to[i];
            to[i] = to[k];
            to[k] = t;
        }
    pcg32_seed(&g, 1, 1);
    for (i = 0; i < c.n; i++) {
        const sph_index k = to[i];
        double p[3];
        int a;
        for (a = 0; a < 3; a++) {
            const sph_index cell = a == 0 ? i % side : a == 1 ? i / side % side : i / side / side;
            p[a] = a < dim ? cell + 0.5 + 0.4 * (pcg32_uniform(&g) - 0.5) : 0.0;
        }
        c.x[k] = SPH_R(p[0]);
        c.y[k] = SPH_R(p[1]);
        c.z[k] = SPH_R(p[2]);
        c.V[k] = SPH_R(1);
        c.f[k] = SPH_R(sin(0.1 * p[0]) + 0.3 * p[1] * p[2] / side);
    }
    free(to);
    return c;
}
/* Clouds most of whose cells are empty. "surface": a layer 6 spacings deep, with every hundredth particle in drops up to 240 spacings above it, in the order of the layer. "galaxy":
   Plummer's sphere within 6.3 of its radii, contrast 1e4, in random order; the radius is that of 57 neighbours on average, by the integral of the square of the density, 45/1024. */
static cloud cloud_sparse(int galaxy, sph_index n)
{
    const sph_index layer = n - n / 100;
    const int side = (int)ceil(sqrt((double)layer / 6.0));
    cloud c;
    pcg32 g;
    sph_index i;
    memset(&c, 0, sizeof c);
    c.dim = 3;
    c.n = n;
    c.radius = SPH_R(galaxy ? pow(57.0 / (n * 4.18879020478639098 * 45.0 / 1024.0), 1.0 / 3.0) : 2.4);
    c.storage = galaxy ? "galaxy" : "surface";
    c.x = (sph_real *)memory((size_t)n * sizeof *c.x);
    c.y = (sph_real *)memory((size_t)n * sizeof *c.y);
    c.z = (sph_real *)memory((size_t)n * sizeof *c.z);
    c.start = (sph_index *)memory(((size_t)n + 1) * sizeof *c.start);
    pcg32_seed(&g, 3, 1);
    for (i = 0; i < n; i++) {
        const double u = pcg32_uniform(&g), v = pcg32_uniform(&g), w = pcg32_uniform(&g);
        double p[3];
        if (galaxy) { /* (r^2 / (1 + r^2))^(3/2) of the mass lies within r */
            const double most = pow(6.3 * 6.3 / (1.0 + 6.3 * 6.3), 1.5), r = 1.0 / sqrt(pow(u * most, -2.0 / 3.0) - 1.0), up = 1.0 - 2.0 * v;
            p[0] = r * sqrt(1.0 - up * up) * cos(6.283185307179586 * w);
            p[1] = r * sqrt(1.0 - up * up) * sin(6.283185307179586 * w);
            p[2] = r * up;
        } else if (i < layer) {
            p[0] = i % side + 0.4 * u;
            p[1] = i / side % side + 0.4 * v;
            p[2] = i / side / side + 0.4 * w;
        } else {
            p[0] = side * u;
            p[1] = side * v;
            p[2] = 6.0 + 240.0 * w;
        }
        c.x[i] = SPH_R(p[0]);
        c.y[i] = SPH_R(p[1]);
        c.z[i] = SPH_R(p[2]);
    }
    return c;
}
/* The same particles with lists of their own. Their memory is set when the capacity is known. */
static cloud cloud_view(const cloud *c)
{
    cloud v = *c;
    v.start = (sph_index *)memory(((size_t)c->n + 1) * sizeof *v.start);
    v.index = 0;
    v.pairs = v.capacity = 0;
    return v;
}
static void cloud_free(cloud *c)
{
    free(c->x);
    free(c->y);
    free(c->z);
    free(c->V);
    free(c->f);
    free(c->start);
    free(c->own_radius);
}

/* ---------------------------------------------------------------- tasks */

enum { GRID, SORT, COUNT, LISTS, NANOFLANN, OPERATOR, SPIN };
enum { ROUNDS = 64, TASKS = 96 };

typedef struct task {
    int kind, which, threads, checked; /* which: the operator */
    const char *what;
    const search *search;
    const ops *ops;
    cloud *c, *sorted; /* sorted: where SORT puts the positions */
    int repeat, rounds, most;
    double seconds[ROUNDS], reference[ROUNDS]; /* of one call; ns per W + F at that moment */
} task;

static task tasks[TASKS];
static int task_count;
static void *work;
static size_t work_size;
static outputs out;
static int rounds_wanted;
static const char *variant = "default";
static FILE *csv, *targets;

static task *add(int kind, const char *what, const search *s, const ops *o, int which, cloud *c, int threads)
{
    task *const t = tasks + task_count;
    if (task_count == TASKS) stop("too many tasks", TASKS);
    task_count++;
    memset(t, 0, sizeof *t);
    t->kind = kind;
    t->what = what;
    t->search = s;
    t->ops = o;
    t->which = which;
    t->c = c;
    t->threads = threads;
    t->most = rounds_wanted;
    t->repeat = 1;
    return t;
}
static void perform(const task *t)
{
    sph_index answer = 0;
    if (t->kind == GRID) answer = t->search->build(t->c, work, work_size, t->threads);
    else if (t->kind == SORT) {
        answer = t->search->build(t->c, work, work_size, t->threads);
        if (answer == 0) answer = t->search->sort(t->c, t->sorted);
    } else if (t->kind == COUNT || t->kind == LISTS) answer = t->search->lists(t->c, t->kind == COUNT, t->threads);
    else if (t->kind == SPIN) sink = t->ops->spin(CACHED, r2_cached, 10 * reference_passes, t->threads);
    else if (t->kind == OPERATOR) answer = t->ops->apply(t->which, t->c, &out, t->threads);
    else {
#if HAVE_NANOFLANN && SPH_SINGLE
        const long long found = nanoflann_float(t->c->dim, (size_t)t->c->n, t->c->x, t->c->y, t->c->z, t->c->radius);
#elif HAVE_NANOFLANN
        const long long found = nanoflann_double(t->c->dim, (size_t)t->c->n, t->c->x, t->c->y, t->c->z, t->c->radius);
#else
        const long long found = -1;
#endif
        if (found < 0) stop("nanoflann failed", 0);
        if (llabs(found - (long long)t->c->n - (long long)t->c->pairs) > 4 + (long long)t->c->pairs / 100000)
            stop("nanoflann finds another number of pairs", (long)(found - (long long)t->c->n - (long long)t->c->pairs));
    }
    if (answer < 0 || answer > t->c->n / 100) stop(t->what, (long)answer); /* a few particles that ICSPM in float finds singular are no failure */
}
static void run_tasks(void)
{
    int r, k;
    for (k = 0; k < task_count; k++)
        if (tasks[k].c->n < 300000) { /* a warm-up, and how often to repeat what is too short for the clock; before GRID comes nothing that LISTS would need */
            const double begin = now();
            double seconds;
            perform(tasks + k);
            seconds = now() - begin;
            if (seconds < 2e-3) tasks[k].repeat = (int)(2e-3 / (seconds + 1e-6)) + 1;
        }
    for (r = 0; r < rounds_wanted; r++) {
        double before = reference_time();
        for (k = 0; k < task_count; k++) {
            task *const t = tasks + k;
            double begin, seconds, after;
            int i;
            if (r >= t->most) continue;
            begin = now();
            for (i = 0; i < t->repeat; i++) perform(t);
            seconds = now() - begin;
            after = reference_time();
            t->seconds[t->rounds] = seconds / t->repeat;
            t->reference[t->rounds] = 0.5 * (before + after);
            t->rounds++;
            before = after;
        }
    }
}

/* seconds of a, and of b if there is one, in one round, over those of c and d; the median */
static double ratio(const task *a, const task *b, const task *c, const task *d)
{
    double v[ROUNDS];
    int r, n = a->rounds < c->rounds ? a->rounds : c->rounds;
    for (r = 0; r < n; r++) v[r] = (a->seconds[r] + (b ? b->seconds[r] : 0.0)) / (c->seconds[r] + (d ? d->seconds[r] : 0.0));
    return median(n, v);
}
/* time per interaction over W + F */
static double over_reference(const task *a, const task *b)
{
    double v[ROUNDS];
    int r;
    for (r = 0; r < a->rounds; r++) v[r] = (a->seconds[r] + (b ? b->seconds[r] : 0.0)) * 1e9 / (double)a->c->pairs / a->reference[r];
    return median(a->rounds, v);
}

/* ---------------------------------------------------------------- answers */

static void csv_line(const cloud *c, const char *what, const char *path, int threads, int rounds, double particle, double interaction, double wf,
                     double nanoflann, double spread, double bytes)
{
    if (!csv) return;
    fprintf(csv, "%s,%s,%d,%ld,%s,%s,%s,%d,%d,", variant, PRECISION, c->dim, (long)c->n,
            c->storage, what, path, threads, rounds);
    if (particle > 0.0) fprintf(csv, "%.4g", particle);
    fputc(',', csv);
    if (interaction > 0.0) fprintf(csv, "%.4g", interaction);
    fputc(',', csv);
    if (wf > 0.0) fprintf(csv, "%.4g", wf);
    fputc(',', csv);
    if (nanoflann > 0.0) fprintf(csv, "%.4g", nanoflann);
    fputc(',', csv);
    if (spread >= 0.0) fprintf(csv, "%.3g", spread);
    fputc(',', csv);
    if (bytes > 0.0) fprintf(csv, "%.4g", bytes);
    fputs(",\n", csv);
}
static void heading(const cloud *c)
{
    printf("\n%s, %s, %dD, %ld particles\n", variant, PRECISION, c->dim, (long)c->n);
    printf("  %-34s %-8s %-8s %3s %12s %15s %8s %10s %7s\n", "", "storage", "path", "thr", "ns/particle", "ns/interaction", "/ (W+F)", "/nanoflann", "spread");
}
/* b, if there is one, is added to a: grid and lists together */
static void line(const char *what, const char *path, const task *a, const task *b, const task *peer)
{
    double t[ROUNDS] = {0.0}, low, high, m, wf, against = peer ? ratio(a, b, peer, 0) : 0.0;
    char versus[16] = "";
    int r;
    if (a->rounds == 0) return;
    for (r = 0; r < a->rounds; r++) t[r] = a->seconds[r] + (b ? b->seconds[r] : 0.0);
    low = high = t[0];
    for (r = 1; r < a->rounds; r++) {
        if (t[r] < low) low = t[r];
        if (t[r] > high) high = t[r];
    }
    m = median(a->rounds, t);
    wf = over_reference(a, b);
    if (peer) sprintf(versus, "%.3f", against);
    printf("  %-34s %-8s %-8s %3d %12.1f %15.2f %8.2f %10s %6.0f%%\n", what, a->c->storage, path, a->threads, m * 1e9 / (double)a->c->n,
           m * 1e9 / (double)a->c->pairs, wf, versus, 100.0 * (high - low) / m);
    csv_line(a->c, what, path, a->threads, a->rounds, m * 1e9 / (double)a->c->n, m * 1e9 / (double)a->c->pairs, wf, against, (high - low) / m, 0.0);
}
static void bytes_line(const cloud *c, const char *what, double bytes)
{
    printf("  %-34s %42.1f bytes/particle\n", what, bytes / (double)c->n);
    csv_line(c, what, "", 0, 0, 0.0, 0.0, 0.0, 0.0, -1.0, bytes / (double)c->n);
}
static void target(const char *what, double value, const char *relation, double limit)
{
    const int met = relation[0] == '<' ? value <= limit : value >= limit;
    if (targets) fprintf(targets, "%s,%s,%s,%.3g,%s,%g,%s\n", variant, PRECISION, what, value, relation, limit, !*relation ? "-" : met ? "met" : "missed");
}

/* over the sizes: smallest and largest cost of an interaction */
typedef struct range {
    double low, high;
    int sizes;
} range;
static void range_add(range *r, double value)
{
    if (r->sizes == 0 || value < r->low) r->low = value;
    if (r->sizes == 0 || value > r->high) r->high = value;
    r->sizes++;
}

/* ---------------------------------------------------------------- one size */

enum { BRIEF, STANDARD, FULL };

typedef struct pair {
    task *grid, *lists;
} pair;
static pair add_pair(const search *s, cloud *c, int threads)
{
    pair p;
    p.grid = add(GRID, "grid", s, 0, 0, c, threads);
    p.lists = add(LISTS, "lists", s, 0, 0, c, threads);
    return p;
}
/* of a host that keeps its particles sorted */
static pair add_sorted(const search *s, cloud *c, cloud *sorted)
{
    pair p;
    p.grid = add(SORT, "grid and sort", s, 0, 0, c, 1);
    p.grid->sorted = sorted;
    p.lists = add(LISTS, "lists", s, 0, 0, sorted, 1);
    return p;
}
static void pair_lines(const char *what, pair p, const task *peer, int parts)
{
    char text[64];
    if (parts) {
        sprintf(text, "grid%s", what);
        line(text, p.grid->search->path, p.grid, 0, 0);
        sprintf(text, "lists%s", what);
        line(text, p.grid->search->path, p.lists, 0, 0);
    }
    sprintf(text, "grid + lists%s", what);
    line(text, p.grid->search->path, p.grid, p.lists, peer);
}
static void count_pairs(cloud *c)
{
    const sph_index built = search_main.build(c, work, work_size, 1), answer = built ? built : search_main.lists(c, 1, 1);
    if (answer) stop("cannot count the pairs", (long)answer);
    c->capacity = c->pairs;
}
static void fill_lists(cloud *c)
{
    if (search_main.build(c, work, work_size, 1) != 0 || search_main.lists(c, 0, 1) != 0) stop("cannot make the lists", 0);
}

/* The target is for hosts that sort; what others pay stands beside it. */
static void random_targets(const char *path, pair lattice, pair shuffled, pair sorted)
{
    char text[80];
    sprintf(text, "%s lists: random order / lattice order at 1e6", path);
    target(text, ratio(sorted.grid, sorted.lists, lattice.grid, lattice.lists), "<=", 1.5);
    sprintf(text, "%s lists: the same without sorting first", path);
    target(text, ratio(shuffled.grid, shuffled.lists, lattice.grid, lattice.lists), "", 0.0);
}

static const char *const operator_name[OPERATORS] = {"density",
                                                     "corrected gradient",
                                                     "Brookshaw Laplacian",
                                                     "Brookshaw rows",
                                                     "apply stored rows",
                                                     "ICSPM derivatives",
                                                     "acceleration (pressure)",
                                                     "fluid rates with viscosity",
                                                     "M-SPH rows (assembly)",
                                                     "SPMHD rates",
                                                     "SPMHD rates with cleaning"};

static void bench_size(int dim, int side, int largest, int level, range *flat_lists, range *flat_density)
{
    cloud lattice = cloud_new(dim, side, 0), shuffled = cloud_new(dim, side, 1), periodic, variable, sorted;
    const sph_index n = lattice.n;
    const int small = n < 30000, big = n >= 300000, near_1e6 = n >= 500000 && n <= 2000000, near_1e5 = n >= 50000 && n < 300000;
    const int full = level == FULL, few = level == BRIEF && big, all = dim == 3;
    const int with_variable = HAVE_VARIABLE && all && !few;
    int64_t capacity;
    sph_index i, *index[2];
    int k, threads;
    pair main_lattice, main_shuffled, main_sorted, main_periodic = {0, 0}, main_variable = {0, 0}, portable = {0, 0}, portable_shuffled = {0, 0},
                                                   portable_sorted = {0, 0}, avx2 = {0, 0}, omp[3] = {{0, 0}, {0, 0}, {0, 0}};
    task *count = 0, *peer = 0, *peer_shuffled = 0, *op[OPERATORS], *checked[OPERATORS], *op_threads[3][OPERATORS], *spinning[3] = {0, 0, 0}, *density_shuffled;

    rounds_wanted = small ? (full ? 15 : 9) : !big ? (full ? 11 : 5) : full && n <= 2000000 ? 5 : 3;
    work_size = search_main.workspace(dim, n);
    if (work_size == 0) stop("no workspace", (long)n);
    work = memory(work_size);

    sorted = cloud_view(&shuffled);
    sorted.x = (sph_real *)memory((size_t)n * sizeof *sorted.x);
    sorted.y = (sph_real *)memory((size_t)n * sizeof *sorted.y);
    sorted.z = (sph_real *)memory((size_t)n * sizeof *sorted.z);
    periodic = cloud_view(&lattice);
    periodic.box = SPH_R(side);
    variable = cloud_view(&lattice);
    variable.radius = SPH_R(2.4 * sqrt(2.0) * 1.0001);
    variable.own_radius = (sph_real *)memory((size_t)n * sizeof *variable.own_radius);
    for (i = 0; i < n; i++) variable.own_radius[i] = SPH_R(2.4 * pow(2.0, 0.5 * sin(6.283185307179586 * (double)lattice.x[i] / side)));

    count_pairs(&lattice);
    count_pairs(&shuffled);
    if (!few) count_pairs(&periodic);
    if (with_variable) count_pairs(&variable);
    index[0] = (sph_index *)memory((size_t)lattice.capacity * sizeof *index[0]);
    capacity = lattice.capacity + 16 + lattice.capacity / 1000; /* paths may differ in pairs on the edge */
    if (shuffled.capacity > capacity) capacity = shuffled.capacity;
    if (periodic.capacity > capacity) capacity = periodic.capacity;
    if (variable.capacity > capacity) capacity = variable.capacity;
    index[1] = (sph_index *)memory((size_t)capacity * sizeof *index[1]);
    lattice.index = shuffled.index = sorted.index = periodic.index = variable.index = index[1];
    lattice.capacity = shuffled.capacity = sorted.capacity = periodic.capacity = variable.capacity = capacity;

    /* ---- search */
    task_count = 0;
    main_lattice = add_pair(&search_main, &lattice, 1);
    if (!few) count = add(COUNT, "count", &search_main, 0, 0, &lattice, 1);
    main_shuffled = add_pair(&search_main, &shuffled, 1);
    main_sorted = add_sorted(&search_main, &shuffled, &sorted);
#if HAVE_PORTABLE
    if (all) portable = add_pair(&search_portable, &lattice, 1);
    if (all) portable_shuffled = add_pair(&search_portable, &shuffled, 1);
    if (all) portable_sorted = add_sorted(&search_portable, &shuffled, &sorted);
#endif
#if HAVE_AVX2
    if (all) avx2 = add_pair(&search_avx2, &lattice, 1);
#endif
    if (!few) main_periodic = add_pair(&search_main, &periodic, 1);
    if (with_variable) {
        main_variable = add_pair(&search_main, &variable, 1);
        if (big && !full) main_variable.grid->most = main_variable.lists->most = 1;
    }
#if HAVE_OPENMP
    for (threads = 1; threads <= 2 && all; threads++) omp[threads] = add_pair(&search_omp, &lattice, threads);
#endif
    if (HAVE_NANOFLANN) {
        peer = add(NANOFLANN, "nanoflann", 0, 0, 0, &lattice, 1);
        if (big) peer->most = full ? (n > 2000000 ? 1 : 3) : all && near_1e6 ? (few ? 1 : 2) : 0;
        else if (!full) peer->most = 3;
        if (full && n <= 2000000) {
            peer_shuffled = add(NANOFLANN, "nanoflann", 0, 0, 0, &shuffled, 1);
            if (big) peer_shuffled->most = 1;
        }
        if (peer->most == 0) peer = 0, task_count--;
    }
    run_tasks();

    heading(&lattice);
    pair_lines("", main_lattice, peer, 1);
    if (count) line("count only", search_main.path, count, 0, 0);
    pair_lines("", main_shuffled, peer_shuffled, 1);
    pair_lines(" + permuting x, y, z", main_sorted, peer_shuffled, 0);
    if (portable.grid) {
        pair_lines("", portable, peer, 1);
        pair_lines("", portable_shuffled, peer_shuffled, 0);
        pair_lines(" + permuting x, y, z", portable_sorted, peer_shuffled, 0);
    }
    if (avx2.grid) pair_lines("", avx2, peer, 1);
    if (!few) pair_lines(" (periodic box)", main_periodic, 0, 0);
    if (with_variable) pair_lines(" (h varies 1:2; larger)", main_variable, 0, 0);
    for (threads = 1; threads <= 2; threads++)
        if (omp[threads].grid) pair_lines(" (OpenMP)", omp[threads], 0, 0);
    if (peer) line("nanoflann: tree + searches", "", peer, 0, 0);
    if (peer_shuffled) line("nanoflann: tree + searches", "", peer_shuffled, 0, 0);
    bytes_line(&lattice, "workspace", (double)work_size);
    bytes_line(&lattice, "lists (start and index)", ((double)n + 1.0 + (double)lattice.pairs) * (double)sizeof(sph_index));

    range_add(flat_lists, over_reference(main_lattice.grid, main_lattice.lists));
    if (dim == 3 && near_1e6) {
        const pair p = portable.grid ? portable : main_lattice;
        const int is_portable = strcmp(p.grid->search->path, "portable") == 0;
        if (peer && is_portable) target("portable lists / nanoflann at 1e6", ratio(p.grid, p.lists, peer, 0), "<=", 0.20);
        if (peer && strcmp(search_main.path, "avx512") == 0)
            target("AVX-512 lists / nanoflann at 1e6", ratio(main_lattice.grid, main_lattice.lists, peer, 0), "<=", 0.08);
        if (is_portable) random_targets("portable", p, portable.grid ? portable_shuffled : main_shuffled, portable.grid ? portable_sorted : main_sorted);
        if (strcmp(search_main.path, "avx512") == 0) random_targets("AVX-512", main_lattice, main_shuffled, main_sorted);
        target(SPH_SINGLE ? "workspace in bytes/particle (float)" : "workspace in bytes/particle (double)", (double)work_size / (double)n,
               "<=", SPH_SINGLE ? 28 : 40);
    }
    if (dim == 3 && largest && omp[2].grid)
        target("2 threads: speed-up of lists at the largest n", ratio(omp[1].grid, omp[1].lists, omp[2].grid, omp[2].lists), ">=", 1.8);

    if (few) goto end;

    /* ---- operators, on the lists of the lattice */
    for (k = 0; k < OUTPUTS; k++) out.g[k] = (sph_real *)memory((size_t)n * sizeof *out.g[k]);
    out.row = (sph_real *)memory((size_t)lattice.pairs * sizeof *out.row);
    lattice.index = index[0];
    fill_lists(&lattice);
    fill_lists(&shuffled);
    task_count = 0;
    memset(op, 0, sizeof op);
    memset(checked, 0, sizeof checked);
    memset(op_threads, 0, sizeof op_threads);
    for (k = 0; k < OPERATORS; k++) {
        if (big && !full && k >= ICSPM) continue;
        op[k] = add(OPERATOR, operator_name[k], 0, &ops_main, k, &lattice, 1);
        if (all && k != APPLY && k < ICSPM && (full || !big)) checked[k] = add(OPERATOR, operator_name[k], 0, &ops_checked, k, &lattice, 1);
#if HAVE_OPENMP
        for (threads = 1; threads <= 2; threads++)
            if (all && k < ICSPM && (full || k == DENSITY || k == GRADIENT))
                op_threads[threads][k] = add(OPERATOR, operator_name[k], 0, &ops_omp, k, &lattice, threads);
#endif
    }
#if HAVE_OPENMP
    for (threads = 1; threads <= 2 && all; threads++) spinning[threads] = add(SPIN, "W + F", 0, &ops_omp, 0, &lattice, threads);
#endif
    density_shuffled = add(OPERATOR, operator_name[DENSITY], 0, &ops_main, DENSITY, &shuffled, 1);
    run_tasks();
    for (k = 0; k < OPERATORS; k++)
        if (op[k]) line(operator_name[k], "", op[k], 0, 0);
    line(operator_name[DENSITY], "", density_shuffled, 0, 0);
    for (k = 0; k < OPERATORS; k++)
        if (checked[k]) line(operator_name[k], "checks", checked[k], 0, 0);
    for (k = 0; k < OPERATORS; k++)
        for (threads = 1; threads <= 2; threads++)
            if (op_threads[threads][k]) line(operator_name[k], "OpenMP", op_threads[threads][k], 0, 0);
    if (checked[DENSITY]) {
        printf("  the checks alone cost, ns/interaction:");
        for (k = 0; k < OPERATORS; k++)
            if (checked[k])
                printf("%s %s %.2f", k ? ";" : "", operator_name[k],
                       (ratio(checked[k], 0, op[k], 0) - 1.0) * median(op[k]->rounds, op[k]->seconds) * 1e9 / (double)lattice.pairs);
        printf("\n");
    }
    range_add(flat_density, over_reference(op[DENSITY], 0));
    if (dim == 3 && near_1e5) {
        target("density / (W+F) at 1e5", over_reference(op[DENSITY], 0), "<=", 1.7);
        target("acceleration / (W+F) at 1e5", over_reference(op[ACCELERATION], 0), "<=", 2.1);
        target("corrected gradient / (W+F) at 1e5", over_reference(op[GRADIENT], 0), "<=", 3.3);
    }
    if (dim == 3 && largest && op_threads[2][DENSITY]) {
        target("2 threads: speed-up of W + F in cache (the machine's)", ratio(spinning[1], 0, spinning[2], 0), "", 0.0);
        target("2 threads: speed-up of density at the largest n", ratio(op_threads[1][DENSITY], 0, op_threads[2][DENSITY], 0), ">=", 1.8);
        target("2 threads: speed-up of corrected gradient at the largest n", ratio(op_threads[1][GRADIENT], 0, op_threads[2][GRADIENT], 0), ">=", 1.8);
    }

    for (k = 0; k < OUTPUTS; k++) free(out.g[k]);
    free(out.row);
end:
    free(index[0]);
    free(index[1]);
    free(work);
    free(periodic.start);
    free(sorted.start);
    free(sorted.x);
    free(sorted.y);
    free(sorted.z);
    free(variable.start);
    free(variable.own_radius);
    cloud_free(&lattice);
    cloud_free(&shuffled);
    fflush(stdout);
}

static void bench_sparse(sph_index n)
{
    int galaxy;
    rounds_wanted = 5;
    work_size = search_main.workspace(3, n);
    work = memory(work_size);
    for (galaxy = 0; galaxy < 2; galaxy++) {
        cloud c = cloud_sparse(galaxy, n), sorted = cloud_view(&c);
        pair plain, portable = {0, 0}, permuted;
        task *peer = 0;
        sorted.x = (sph_real *)memory((size_t)n * sizeof *sorted.x);
        sorted.y = (sph_real *)memory((size_t)n * sizeof *sorted.y);
        sorted.z = (sph_real *)memory((size_t)n * sizeof *sorted.z);
        count_pairs(&c);
        c.capacity = sorted.capacity = c.pairs + 16 + c.pairs / 1000; /* paths may differ in pairs on the edge */
        c.index = sorted.index = (sph_index *)memory((size_t)c.capacity * sizeof *c.index);
        task_count = 0;
        plain = add_pair(&search_main, &c, 1);
        permuted = add_sorted(&search_main, &c, &sorted);
#if HAVE_PORTABLE
        portable = add_pair(&search_portable, &c, 1);
#endif
        if (HAVE_NANOFLANN) {
            peer = add(NANOFLANN, "nanoflann", 0, 0, 0, &c, 1);
            peer->most = 3;
        }
        run_tasks();
        if (!galaxy) heading(&c);
        pair_lines("", plain, peer, 0);
        pair_lines(" + permuting x, y, z", permuted, peer, 0);
        if (portable.grid) pair_lines("", portable, peer, 0);
        if (peer) line("nanoflann: tree + searches", "", peer, 0, 0);
        free(c.index);
        free(sorted.start);
        free(sorted.x);
        free(sorted.y);
        free(sorted.z);
        cloud_free(&c);
    }
    free(work);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    const char *sizes = "1e4,1e5", *csv_name = 0, *targets_name = 0;
    int dim = 3, level = STANDARD, k;
    range flat_lists = {0.0, 0.0, 0}, flat_density = {0.0, 0.0, 0};
    double wf, bandwidth;
    for (k = 1; k < argc; k++) {
        const char *const value = k + 1 < argc ? argv[k + 1] : "";
        if (strcmp(argv[k], "-full") == 0) level = FULL;
        else if (strcmp(argv[k], "-brief") == 0) level = BRIEF;
        else if (strcmp(argv[k], "-name") == 0) variant = value, k++;
        else if (strcmp(argv[k], "-n") == 0) sizes = value, k++;
        else if (strcmp(argv[k], "-dim") == 0) dim = atoi(value), k++;
        else if (strcmp(argv[k], "-csv") == 0) csv_name = value, k++;
        else if (strcmp(argv[k], "-targets") == 0) targets_name = value, k++;
        else stop("usage: bench [-name TEXT] [-n 1e4,1e5,...] [-dim 2|3] [-csv FILE] [-targets FILE] [-brief|-full]", 0);
    }
    if (dim != 2 && dim != 3) stop("-dim must be 2 or 3", dim);
    if (csv_name && !(csv = fopen(csv_name, "a"))) stop(csv_name, 0);
    if (targets_name && !(targets = fopen(targets_name, "a"))) stop(targets_name, 0);

    wf = reference_start();
    bandwidth = copy_bandwidth();
    printf("\n======== %s, %s: one W + F from r^2 in cache %.2f ns; copy %.1f GB/s; search path %s\n", variant, PRECISION, wf, bandwidth, search_main.path);
    if (csv)
        fprintf(csv, "%s,%s,,,,W + F from r^2 in cache,,1,15,,%.4g,1,,,,\n%s,%s,,,,copy bandwidth,,1,5,,,,,,,%.3g\n", variant, PRECISION, wf, variant,
                PRECISION, bandwidth);

    while (*sizes) {
        char *end;
        const double n = strtod(sizes, &end);
        if (end == sizes || !(n >= 1000.0) || n > 3e7) stop("-n: numbers between 1e3 and 3e7, separated by commas", 0);
        sizes = *end == ',' ? end + 1 : end;
        bench_size(dim, (int)(pow(n, 1.0 / dim) + 0.5), *sizes == 0, level, &flat_lists, &flat_density);
        if (dim == 3 && n >= 5e4 && n < 3e5) bench_sparse((sph_index)n);
    }
    if (flat_lists.sizes > 1 && level != BRIEF) {
        printf("\n  largest / smallest cost of an interaction, in W + F, over all n: lists %.2f, density %.2f\n", flat_lists.high / flat_lists.low,
               flat_density.high / flat_density.low);
        target(dim == 2 ? "lists flat in n (2D)" : "lists flat in n (3D)", flat_lists.high / flat_lists.low, "<=", 1.25);
        target(dim == 2 ? "density flat in n (2D)" : "density flat in n (3D)", flat_density.high / flat_density.low, "<=", 1.25);
    }
    if (csv && fclose(csv) != 0) stop(csv_name, 0);
    if (targets && fclose(targets) != 0) stop(targets_name, 0);
    return 0;
}

#endif
