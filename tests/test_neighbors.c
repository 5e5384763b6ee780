/* SPDX-License-Identifier: MIT */
/*
 * test_neighbors.c - the neighbour search against all pairs, on clouds of every kind, and nothing written where it must not be.
 *
 *     test_neighbors              the tests
 *     test_neighbors checksums    a line for each of some lists instead, to compare builds and numbers of threads by (tests/compile/paths.sh)
 *                                 -DCHECKSUMS_ONLY=1: nothing else, in a third of the time to compile
 *
 * Where a list is compared with all pairs, a pair may be in it or not if its distance is within 8 ulp of the support: in an open domain of the support itself, where an axis
 * is periodic of the largest of the support, the length of the box and the pair's own coordinates along that axis. All others are compared exactly.
 */
#define SPH_FN static inline /* one copy of each function is enough */
#ifndef CHECKSUMS_ONLY
#define CHECKSUMS_ONLY 0
#endif

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

enum { CRITERIA = 4, FLAGS = 16, EDGE_ULPS = 8 };

/* ---- checks that say which search they belong to ---- */

static struct {
    const char *name;
    int dim, criterion, flags;
    long sources, targets;
} now = {"", 0, 0, 0, 0, 0};

static int expect(int holds, int line, const char *text)
{
    if (!check_count(holds))
        fprintf(stderr, "test_neighbors.c:%d: failed: %s: %s in %dD, criterion %d, flags %d, %ld sources, %ld targets\n", line, text, now.name, now.dim,
                now.criterion, now.flags, now.sources, now.targets);
    return holds;
}
#define EXPECT(condition) expect((condition) ? 1 : 0, __LINE__, #condition)

/* ---- memory with guards on both sides ---- */

enum { GUARD = 64, PATTERN = 0x5A };

typedef struct guarded {
    unsigned char *base;
    size_t bytes;
} guarded;

static guarded guarded_new(size_t bytes)
{
    guarded g;
    g.base = (unsigned char *)cloud_memory(bytes + 2 * GUARD, 1);
    g.bytes = bytes;
    memset(g.base, PATTERN, bytes + 2 * GUARD);
    return g;
}
static void *guarded_memory(const guarded *g) { return g->base + GUARD; }

/* the guards, and all from the byte `from` on */
static int guarded_unwritten_from(const guarded *g, size_t from)
{
    size_t i;
    for (i = 0; i < GUARD; i++)
        if (g->base[i] != PATTERN) return 0;
    for (i = GUARD + from; i < GUARD + g->bytes + GUARD; i++)
        if (g->base[i] != PATTERN) return 0;
    return 1;
}
static int guarded_intact(const guarded *g) { return guarded_unwritten_from(g, g->bytes); }
static int guarded_unwritten(const guarded *g) { return guarded_unwritten_from(g, 0); }

/* ---- a grid with its workspace ---- */

typedef struct grid {
    sph_grid g;
    guarded work;
} grid;

static grid grid_of(int dim, sph_points sources, sph_scalars radius)
{
    grid g;
    g.work = guarded_new(sph_grid_workspace(dim, sources.n));
    EXPECT(sph_grid_build(dim, sources, radius, guarded_memory(&g.work), g.work.bytes, &g.g) == 0);
    EXPECT(guarded_intact(&g.work));
    return g;
}
static grid grid_new(int dim, sph_points sources, sph_real radius) { return grid_of(dim, sources, sph_scalars_same(&radius)); }
static void grid_free(grid *g)
{
    EXPECT(guarded_intact(&g->work));
    free(g->work.base);
}

/* ---- all pairs ---- */

typedef struct problem {
    int dim;
    sph_points sources, targets;
    sph_scalars source_radius, target_radius;
    long double *distance; /* of target i and the nearest image of source j, at [i * sources.n + j] */
    long double *scale;    /* likewise: what rounding goes by besides the support */
} problem;

static sph_real value(sph_scalars s, sph_index i) { return s.p[(size_t)i * s.stride]; }

static long double difference(const sph_real *a, size_t i, const sph_real *b, size_t j, sph_real box)
{
    const long double d = (long double)a[i] - (long double)b[j], length = (long double)box;
    if (length <= 0.0L || fabsl(d) <= 0.5L * length) return d;
    if (fabsl(d) <= 1.5L * length) return d > 0.0L ? d - length : d + length;
    return remainderl(d, length);
}

static long double larger(long double a, long double b) { return a > b ? a : b; }

/* One pair. *scale: the largest of length and coordinates along periodic axes, 0 if there are none. */
static long double pair_distance(int dim, sph_points targets, sph_index i, sph_points sources, sph_index j, long double *scale)
{
    const sph_real *const x[3] = {targets.x, targets.y, targets.z}, *const y[3] = {sources.x, sources.y, sources.z};
    const sph_real box[3] = {sources.box.x, sources.box.y, sources.box.z};
    const size_t a = (size_t)i * targets.stride, b = (size_t)j * sources.stride;
    long double sum = 0.0L;
    int c;
    *scale = 0.0L;
    for (c = 0; c < dim; c++) {
        const long double d = difference(x[c], a, y[c], b, box[c]);
        sum += d * d;
        if (box[c] > SPH_R(0)) *scale = larger(*scale, larger((long double)box[c], larger(fabsl((long double)x[c][a]), fabsl((long double)y[c][b]))));
    }
    return sqrtl(sum);
}

static problem problem_new(int dim, sph_points sources, sph_points targets, sph_scalars source_radius, sph_scalars target_radius)
{
    problem p;
    sph_index i, j;
    p.dim = dim;
    p.sources = sources;
    p.targets = targets;
    p.source_radius = source_radius;
    p.target_radius = target_radius;
    p.distance = (long double *)cloud_memory((size_t)sources.n * (size_t)targets.n, sizeof *p.distance);
    p.scale = (long double *)cloud_memory((size_t)sources.n * (size_t)targets.n, sizeof *p.scale);
    for (i = 0; i < targets.n; i++)
        for (j = 0; j < sources.n; j++) {
            const size_t at = (size_t)i * (size_t)sources.n + (size_t)j;
            p.distance[at] = pair_distance(dim, targets, i, sources, j, &p.scale[at]);
        }
    now.dim = dim;
    now.sources = (long)sources.n;
    now.targets = (long)targets.n;
    return p;
}
static void problem_free(problem *p)
{
    free(p->distance);
    free(p->scale);
}

/* the spacing of sph_real at x > 0 */
static long double ulp(long double x)
{
    int e;
    (void)frexpl(x, &e);
    return ldexpl((long double)SPH_EPSILON, e - 1);
}

static long double support(int criterion, long double R_i, long double R_j)
{
    switch (criterion) {
    case SPH_GATHER:
        return R_i;
    case SPH_SCATTER:
        return R_j;
    case SPH_LARGER:
        return R_i > R_j ? R_i : R_j;
    default:
        return 0.5L * (R_i + R_j);
    }
}

/* 1: r < R, 0: not, 2: so near to R that either will do */
enum { EITHER = 2 };
static int within(long double r, long double R, long double scale)
{
    const long double off = fabsl(r - R), size = larger(R, scale);
    if (off > 1e-5L * size) return r < R; /* 8 ulp are less: quickly */
    return off <= EDGE_ULPS * ulp(size) ? EITHER : r < R;
}

/* must j be in the row of i? */
static int belongs(const problem *p, int criterion, int flags, sph_index i, sph_index j)
{
    if (!(flags & SPH_LIST_FOREIGN)) {
        if (j == i && !(flags & SPH_LIST_SELF)) return 0;
        if (j < i && (flags & SPH_LIST_HALF)) return 0;
    }
    {
        const size_t at = (size_t)i * (size_t)p->sources.n + (size_t)j;
        const long double R = support(criterion, (long double)value(p->target_radius, i), (long double)value(p->source_radius, j)), r = p->distance[at];
        return within(r, R, p->scale[at]);
    }
}

/* ---- lists, and what they must be ---- */

typedef struct lists {
    guarded start_memory, index_memory;
    sph_index *start, *index;
    int64_t pairs;
} lists;

static void lists_free(lists *l)
{
    free(l->start_memory.base);
    free(l->index_memory.base);
}

/* a null index: counts */
static sph_index call(const problem *p, const grid *g, int criterion, int flags, sph_index *start, sph_index *index, int64_t capacity, int64_t *pairs)
{
    if (!index) return sph_grid_count(p->dim, &g->g, sph_query_of(p->targets, criterion, p->target_radius, flags), start, pairs);
    return sph_grid_lists(p->dim, &g->g, sph_query_of(p->targets, criterion, p->target_radius, flags), start, index, capacity, pairs);
}

static void check_rows(const problem *p, int criterion, int flags, const lists *l)
{
    const sph_index n = p->sources.n;
    sph_index *const seen = (sph_index *)cloud_memory((size_t)n, sizeof *seen); /* the last row it was seen in, from 1 */
    sph_index i, j, q;
    long missed = 0, extra = 0, twice = 0, none = 0, descents = 0, backwards = 0;
    for (i = 0; i < p->targets.n; i++) {
        backwards += l->start[i + 1] < l->start[i];
        for (q = l->start[i]; q < l->start[i + 1]; q++) {
            j = l->index[q];
            if (j < 0 || j >= n) {
                none++;
                continue;
            }
            twice += seen[j] == i + 1;
            seen[j] = (sph_index)(i + 1);
            descents += q > l->start[i] && j <= l->index[q - 1];
        }
        for (j = 0; j < n; j++) {
            const int want = belongs(p, criterion, flags, i, j);
            missed += want == 1 && seen[j] != i + 1;
            extra += want == 0 && seen[j] == i + 1;
        }
    }
    EXPECT(missed == 0);
    EXPECT(extra == 0);
    EXPECT(twice == 0);
    EXPECT(none == 0);
    EXPECT(backwards == 0);
    if (flags & SPH_LIST_SORTED) EXPECT(descents == 0);
    free(seen);
}

/* Counts, fills with too little memory and with just enough, and compares with all pairs. */
static lists lists_new(const char *name, const problem *p, const grid *g, int criterion, int flags)
{
    const sph_index n = p->targets.n;
    guarded count = guarded_new(((size_t)n + 1) * sizeof(sph_index));
    sph_index *const counted = (sph_index *)guarded_memory(&count);
    int64_t pairs = -1;
    lists l;
    now.name = name;
    now.criterion = criterion;
    now.flags = flags;

    if (!EXPECT(call(p, g, criterion, flags, counted, 0, 0, &pairs) == 0)) {
        memset(counted, 0, count.bytes);
        pairs = 0;
    }
    EXPECT(guarded_intact(&count));
    EXPECT(counted[0] == 0);
    EXPECT(counted[n] == pairs);

    l.start_memory = guarded_new(count.bytes);
    l.start = (sph_index *)guarded_memory(&l.start_memory);
    l.index_memory = guarded_new((size_t)pairs * sizeof(sph_index));
    l.index = (sph_index *)guarded_memory(&l.index_memory);
    if (pairs > 0) {
        EXPECT(call(p, g, criterion, flags, l.start, l.index, pairs - 1, &l.pairs) == SPH_ERROR_CAPACITY);
        EXPECT(l.pairs == pairs);
        EXPECT(guarded_intact(&l.start_memory));
        EXPECT(guarded_unwritten_from(&l.index_memory, (size_t)(pairs - 1) * sizeof(sph_index)));
    }
    l.pairs = -1;
    if (!EXPECT(call(p, g, criterion, flags, l.start, l.index, pairs, &l.pairs) == 0)) memset(l.start, 0, count.bytes);
    EXPECT(l.pairs == pairs);
    EXPECT(guarded_intact(&l.start_memory));
    EXPECT(guarded_intact(&l.index_memory));
    EXPECT(memcmp(l.start, counted, count.bytes) == 0);
    check_rows(p, criterion, flags, &l);
    free(count.base);
    return l;
}

static int64_t check_lists(const char *name, const problem *p, const grid *g, int criterion, int flags)
{
    lists l = lists_new(name, p, g, criterion, flags);
    lists_free(&l);
    return l.pairs;
}

/* ---- searches in one cloud ---- */

/* between most / ratio and most, of which there is one */
static sph_real *random_radii(sph_index n, sph_real most, double ratio, pcg32 *g)
{
    sph_real *const R = (sph_real *)cloud_memory((size_t)n, sizeof *R);
    sph_index i;
    for (i = 0; i < n; i++) R[i] = SPH_R((double)most * pow(ratio, -pcg32_uniform(g)));
    R[n / 2] = most;
    R[n - 1] = SPH_R((double)most / ratio);
    return R;
}
/* of radii that the cells serve, and of those that take a tree */
static const double ratios_of_radii[] = {3.9, 30.0};
enum { RATIOS = 2 };

static int next_flags(void)
{
    static int turn;
    turn = (turn + 5) % FLAGS;
    return turn & SPH_LIST_FOREIGN ? turn & ~(SPH_LIST_SELF | SPH_LIST_HALF) : turn; /* which exclude each other */
}

/* All criteria, with one radius and with one for each particle, flags in turn. Returns the number of pairs with one radius and no flag. */
static int64_t search(const char *name, int dim, sph_points x, double length)
{
    const sph_real radius = SPH_R(length);
    pcg32 random;
    sph_real *R;
    int criterion, ratio;
    int64_t pairs;
    problem p = problem_new(dim, x, x, sph_scalars_same(&radius), sph_scalars_same(&radius));
    grid g;
    now.name = name;
    g = grid_new(dim, x, radius);
    pairs = check_lists(name, &p, &g, SPH_GATHER, 0);
    for (criterion = 0; criterion < CRITERIA; criterion++) check_lists(name, &p, &g, criterion, next_flags());
    pcg32_seed(&random, (uint64_t)x.n, 3);
    for (ratio = 0; ratio < RATIOS; ratio++) {
        R = random_radii(x.n, radius, ratios_of_radii[ratio], &random);
        p.target_radius = sph_scalars_array(R);
        check_lists(name, &p, &g, ratio ? SPH_GATHER : SPH_LARGER, next_flags()); /* one radius of all sources */
        p.source_radius = p.target_radius;
        grid_free(&g);
        g = grid_of(dim, x, p.source_radius);
        if (x.n > 2) EXPECT((g.g.levels > 0) == (ratio == 1));
        for (criterion = 0; criterion < CRITERIA; criterion++) check_lists(name, &p, &g, criterion, next_flags());
        p.source_radius = sph_scalars_same(&radius);
        grid_free(&g);
        g = grid_new(dim, x, radius);
        free(R);
    }
    problem_free(&p);
    grid_free(&g);
    return pairs;
}

/* ---- clouds in the unit box, moved and stretched afterwards ---- */

enum { RANDOM, LATTICE, CLUSTERED, COINCIDENT, COLLAPSED, COLLINEAR, CLUMPS, PLANES, KINDS };
static const char *const kind_name[KINDS] = {"random", "lattice", "clustered", "coincident", "collapsed", "collinear", "two clumps", "planes"};

/* the lattice has particles at 0 and at 1, or, if periodic, at 0 only */
static cloud make(int kind, int dim, sph_index n, int periodic, pcg32 *g)
{
    cloud c = cloud_new(dim, n);
    sph_real *const coordinate[3] = {c.x, c.y, c.z};
    const int side = (int)ceil(pow((double)n, 1.0 / dim) - 1e-9), gaps = periodic ? side : side - 1;
    sph_index i;
    int a;
    c.side = side;
    for (i = 0; i < n; i++) {
        const int cell[3] = {(int)i % side, (int)i / side % side, (int)i / side / side};
        const double along = pcg32_uniform(g);
        for (a = 0; a < dim; a++) {
            const double u = pcg32_uniform(g);
            double v = u;
            if (kind == LATTICE) v = side > 1 ? (double)cell[a] / gaps : 0.0;
            if (kind == CLUSTERED) v = u * u * u * u * u;
            if (kind == COINCIDENT) v = 0.625;
            if (kind == COLLAPSED) v = 0.3 + 1e-9 * u;
            if (kind == COLLINEAR) v = (1.0 + a) * along / 3.0;
            if (kind == CLUMPS) v = 1e-12 * u + (i % 2 ? 0.99 : 0.0);
            if (kind == PLANES) v = a == 0 ? 0.25 * (double)(i % 5) : u;
            coordinate[a][i] = SPH_R(v);
        }
    }
    return c;
}

static void move(cloud *c, double scale, double shift)
{
    sph_real *const coordinate[3] = {c->x, c->y, c->z};
    sph_index i;
    int a;
    for (a = 0; a < c->dim; a++)
        for (i = 0; i < c->n; i++) coordinate[a][i] = SPH_R(scale * (double)coordinate[a][i] + shift * (1.0 + 0.3 * a));
}

/* coordinates that the dimension has */
static sph_points points(const cloud *c) { return sph_points_separate(c->n, c->x, c->dim > 1 ? c->y : 0, c->dim > 2 ? c->z : 0); }

static void test_clouds(void)
{
    static const double radii[] = {0.07, 0.2, 0.33333333333333333, 0.5, 1.0};
    pcg32 g;
    int kind, dim;
    size_t r;
    pcg32_seed(&g, 4, 4);
    for (dim = 1; dim <= 3; dim++)
        for (kind = 0; kind < KINDS; kind++) {
            const sph_index n = dim == 1 ? 61 : dim == 2 ? 121 : 125;
            const int64_t all = (int64_t)n * (n - 1);
            cloud c = make(kind, dim, n, 0, &g);
            int64_t least, most = -1;
            for (r = 0; r < sizeof radii / sizeof *radii; r++) most = search(kind_name[kind], dim, points(&c), radii[r]);
            CHECK(most > 0);
            least = search(kind_name[kind], dim, points(&c), BY_PRECISION(1e-30, 1e-15));
            CHECK(kind == COINCIDENT ? least == all : least >= 0);        /* coincident particles are neighbours at any radius */
            CHECK(search(kind_name[kind], dim, points(&c), 50.0) == all); /* all of them */
            move(&c, 3.0, -7.0);                                          /* negative coordinates */
            search(kind_name[kind], dim, points(&c), 0.6);
            move(&c, 1e-3, 0.25); /* near together, and not at the origin */
            search(kind_name[kind], dim, points(&c), 7e-4);
            move(&c, 1e6, -3.0);
            search(kind_name[kind], dim, points(&c), 600.0);
            cloud_free(&c);
        }
}

/* Lattices whose spacing divides the radius: pairs at just the radius fall on either side of it by rounding, and cells end where particles are. */
static void test_rounding(void)
{
    int side, dim, m;
    for (side = 6; side <= 108; side += 3)
        for (m = 1; m <= 3; m++) {
            cloud c = cloud_lattice(1, side, 1.0, 0.0, 1);
            search("spacing divides the radius", 1, points(&c), m * c.dx);
            search("spacing divides the radius", 1, points(&c), (double)((c.x[m] - c.x[0])));
            move(&c, 0.3, 0.1);
            search("spacing divides the radius, moved", 1, points(&c), 0.3 * m * c.dx);
            move(&c, 1.0, -20.0);
            search("spacing divides the radius, far", 1, points(&c), 0.3 * m * c.dx);
            cloud_free(&c);
        }
    for (dim = 2; dim <= 3; dim++)
        for (side = 5; side <= (dim == 2 ? 17 : 8); side += 3) {
            cloud c = cloud_lattice(dim, side, 1.0, 0.0, 1);
            search("spacing divides the radius", dim, points(&c), c.dx);
            search("spacing divides the radius", dim, points(&c), 2.0 * c.dx);
            move(&c, 0.3, 0.1);
            search("spacing divides the radius, moved", dim, points(&c), 0.6 * c.dx);
            cloud_free(&c);
        }
}

static void test_few(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_new(dim, 1);
        sph_points none = points(&c);
        sph_grid g;
        unsigned char work[1];
        const sph_real one = SPH_R(1);
        none.n = 0;
        CHECK(sph_grid_workspace(dim, 0) > 0 && sph_grid_workspace(dim, -1) == 0);
        CHECK(sph_grid_build(dim, none, sph_scalars_same(&one), work, sizeof work, &g) == 0);
        none.n = -1;
        CHECK(sph_grid_build(dim, none, sph_scalars_same(&one), work, sizeof work, &g) == SPH_ERROR_COUNT);
        CHECK(search("one", dim, points(&c), 1.0) == 0);
        CHECK(search("one, periodic", dim, sph_points_periodic(points(&c), SPH_R(2), SPH_R(2), SPH_R(2)), 1.0) == 0); /* not its own neighbour */
        cloud_free(&c);

        c = cloud_new(dim, 2);
        c.x[1] = SPH_R(0.5);
        CHECK(search("two", dim, points(&c), 1.0) == 2);
        CHECK(search("two", dim, points(&c), 0.49999) == 0);
        CHECK(search("two", dim, points(&c), 0.50001) == 2);
        CHECK(search("two", dim, points(&c), 0.1) == 0);
        CHECK(search("two, periodic", dim, sph_points_periodic(points(&c), SPH_R(0.625), SPH_R(0), SPH_R(0)), 0.126) == 2);
        CHECK(search("two, periodic", dim, sph_points_periodic(points(&c), SPH_R(0.625), SPH_R(0), SPH_R(0)), 0.124) == 0);
        CHECK(search("two, periodic", dim, sph_points_periodic(points(&c), SPH_R(0.5), SPH_R(0), SPH_R(0)), 0.01) == 2); /* images of each other */
        c.x[1] = SPH_R(-1e12);                                                                                           /* nothing in between */
        CHECK(search("two", dim, points(&c), 0.1) == 0);
        CHECK(search("two", dim, points(&c), 2e12) == 2);
        cloud_free(&c);
    }
}

/* Two clumps 1e12 and 1e30 apart: memory and time must not follow the empty domain. */
static void test_empty_domain(void)
{
    static const double distances[] = {1e12, 1e30};
    pcg32 g;
    int dim, d;
    pcg32_seed(&g, 9, 9);
    for (dim = 1; dim <= 3; dim++)
        for (d = 0; d < 2; d++) {
            cloud c = make(RANDOM, dim, 200, 0, &g);
            const double distance = distances[d];
            int64_t together, apart;
            sph_index i;
            for (i = 100; i < 200; i++) c.x[i] += SPH_R(3); /* two boxes that do not touch */
            together = search("two boxes", dim, points(&c), 0.25);
            for (i = 100; i < 200; i++) {
                c.x[i] = SPH_R(distance); /* where nothing but multiples of the spacing of numbers is left */
                if (dim > 1) c.y[i] = SPH_R(-distance);
                if (dim > 2) c.z[i] = SPH_R(distance);
            }
            apart = search("far apart", dim, points(&c), 0.25);
            CHECK(together > 0 && apart >= 100 * 99);
            search("far apart in a large box", dim, sph_points_periodic(points(&c), SPH_R(4.0 * distance), SPH_R(4.0 * distance), SPH_R(4.0 * distance)), 0.25);
            if (dim > 1) { /* periodic across: no more than 2^20 lengths from the origin */
                sph_grid g0;
                const sph_real radius = SPH_R(0.25);
                guarded work = guarded_new(sph_grid_workspace(dim, 200));
                CHECK(sph_grid_build(dim, sph_points_periodic(points(&c), SPH_R(0), SPH_R(3), SPH_R(0)), sph_scalars_same(&radius), guarded_memory(&work), work.bytes, &g0) ==
                      SPH_ERROR_BOX);
                CHECK(guarded_unwritten(&work));
                free(work.base);
                for (i = 100; i < 200; i++) c.y[i] = SPH_R((i % 3 == 1 ? 1e6 : -1e6) * 3.0 * pcg32_uniform(&g));
                search("far apart, periodic across", dim, sph_points_periodic(points(&c), SPH_R(0), SPH_R(3), SPH_R(0)), 0.25);
            }
            cloud_free(&c);
        }
}

/* ---- periodic boxes ---- */

static void test_boxes(void)
{
    static const double ratios[] = {2.0, 2.5, 3.0, 4.0, 7.0, 24.0}, lengths[] = {1.0, 0.7, 1000.0}, stretch[3] = {1.0, 1.5, 2.25};
    int dim, kind, mask, turn = 0;
    size_t r;
    pcg32 g;
    pcg32_seed(&g, 12, 5);
    for (dim = 1; dim <= 3; dim++)
        for (kind = 0; kind < KINDS; kind++)
            for (mask = 1; mask < 1 << dim; mask++)
                for (r = 0; r < sizeof ratios / sizeof *ratios; r++, turn++) {
                    cloud c = make(kind, dim, dim == 1 ? 96 : dim == 2 ? 144 : 64, 1, &g);
                    sph_real *const coordinate[3] = {c.x, c.y, c.z};
                    const int images = turn % 5 == 3 ? 3 : turn % 5 == 4 ? 40 : 0; /* positions outside of the box */
                    const double length = lengths[turn % 3], shift = turn % 5 == 1 ? -0.5 : turn % 5 == 2 ? 0.77 : 0.0;
                    sph_real box[3];
                    sph_index i;
                    int a;
                    for (a = 0; a < 3; a++) box[a] = SPH_R(mask >> a & 1 ? length * stretch[a] : 0.0);
                    for (a = 0; a < dim; a++)
                        for (i = 0; i < c.n; i++) {
                            const double image = mask >> a & 1 ? floor((2.0 * pcg32_uniform(&g) - 1.0) * images + 0.5) : 0.0;
                            coordinate[a][i] = SPH_R(length * stretch[a] * ((double)coordinate[a][i] + image + shift));
                        }
                    /* the shortest periodic length is this many radii; not more, by rounding */
                    for (a = 0; !(mask >> a & 1);) a++;
                    search(kind_name[kind], dim, sph_points_periodic(points(&c), box[0], box[1], box[2]), (double)box[a] / ratios[r]);
                    cloud_free(&c);
                }
}

/* Radii that miss or reach the distance of a pair by twice the tolerance: open, periodic, and periodic with one particle far out, which must not cost the others their digits. */
static void test_sharp(void)
{
    enum { N = 40, PAIRS = 20 };
    int dim, box, side, i;
    pcg32 g;
    pcg32_seed(&g, 31, 5);
    for (dim = 1; dim <= 3; dim++)
        for (box = 0; box < 3; box++) {
            cloud c = make(RANDOM, dim, N, 1, &g);
            const sph_real length = SPH_R(box ? 1.1 : 0.0), reach = SPH_R(0.55);
            const sph_points x = sph_points_periodic(points(&c), length, length, length);
            if (box == 2) {
                c.x[N - 1] = SPH_R(-1e6);
                if (dim > 1) c.y[N - 1] = SPH_R(1e6);
                if (dim > 2) c.z[N - 1] = SPH_R(-1e6);
            }
            for (i = 0; i < PAIRS; i++)
                for (side = -1; side <= 1; side += 2) {
                    long double scale;
                    const long double r = pair_distance(dim, x, (sph_index)i, x, (sph_index)(i + 1), &scale);
                    const sph_real radius = SPH_R(r + side * 2.0L * EDGE_ULPS * ulp(larger(r, scale)));
                    sph_real R[N];
                    problem p;
                    grid g1;
                    int a;
                    if (!(radius > SPH_R(0) && radius < reach)) continue;
                    p = problem_new(dim, x, x, sph_scalars_same(&radius), sph_scalars_same(&radius));
                    now.name = "sharp";
                    EXPECT(belongs(&p, SPH_GATHER, 0, (sph_index)i, (sph_index)(i + 1)) == (side > 0));
                    g1 = grid_new(dim, x, radius);
                    check_lists("sharp", &p, &g1, i % CRITERIA, 0);
                    grid_free(&g1);
                    g1 = grid_new(dim, x, reach);
                    check_lists("sharp", &p, &g1, SPH_GATHER, SPH_LIST_FOREIGN);
                    grid_free(&g1);
                    for (a = 0; a < N; a++) R[a] = a == i ? radius : a % 2 ? reach : SPH_R(0.1) * reach; /* in a tree */
                    g1 = grid_of(dim, x, sph_scalars_array(R));
                    p.source_radius = p.target_radius = sph_scalars_array(R);
                    check_lists("sharp", &p, &g1, SPH_GATHER, 0);
                    check_lists("sharp", &p, &g1, SPH_SCATTER, 0);
                    problem_free(&p);
                    grid_free(&g1);
                }
            cloud_free(&c);
        }
}

/* ---- flags, criteria and targets ---- */

static void test_flags(void)
{
    int dim, criterion, flags, periodic;
    pcg32 random;
    pcg32_seed(&random, 2, 8);
    for (dim = 1; dim <= 3; dim++)
        for (periodic = 0; periodic < 2; periodic++) {
            enum { N = 60 };
            cloud c = make(RANDOM, dim, N, 1, &random);
            const sph_real length = SPH_R(periodic), radius = SPH_R(0.3);
            const sph_points x = sph_points_periodic(points(&c), length, length, length);
            sph_real *const R[RATIOS] = {random_radii(N, radius, ratios_of_radii[0], &random), random_radii(N, radius, ratios_of_radii[1], &random)};
            grid g = grid_new(dim, x, radius), each[RATIOS] = {grid_of(dim, x, sph_scalars_array(R[0])), grid_of(dim, x, sph_scalars_array(R[1]))};
            problem p = problem_new(dim, x, x, sph_scalars_same(&radius), sph_scalars_same(&radius));
            int ratio;
            for (criterion = 0; criterion < CRITERIA; criterion++)
                for (flags = 0; flags < FLAGS; flags++) {
                    const int plain = flags & ~SPH_LIST_SORTED;
                    int64_t pairs, full;
                    if (flags & SPH_LIST_FOREIGN && flags & (SPH_LIST_SELF | SPH_LIST_HALF)) continue;
                    p.source_radius = p.target_radius = sph_scalars_same(&radius);
                    pairs = check_lists("flags", &p, &g, criterion, flags);
                    full = check_lists("flags", &p, &g, criterion, 0);
                    CHECK(full > 0);
                    if (plain == SPH_LIST_HALF) CHECK(2 * pairs == full);
                    if (plain == SPH_LIST_SELF) CHECK(pairs == full + N);
                    if (plain == (SPH_LIST_HALF | SPH_LIST_SELF)) CHECK(2 * (pairs - N) == full);
                    for (ratio = 0; ratio < RATIOS; ratio++) {
                        p.source_radius = p.target_radius = sph_scalars_array(R[ratio]);
                        check_lists("flags, a radius for each", &p, &each[ratio], criterion, flags);
                    }
                }
            problem_free(&p);
            grid_free(&g);
            for (ratio = 0; ratio < RATIOS; ratio++) {
                grid_free(&each[ratio]);
                free(R[ratio]);
            }
            cloud_free(&c);
        }
}

/* [i * n + j]: j is in the row of i */
static unsigned char *matrix_of(const lists *l, sph_index n)
{
    unsigned char *const m = (unsigned char *)cloud_memory((size_t)n * (size_t)n, 1);
    sph_index i, q;
    for (i = 0; i < n; i++)
        for (q = l->start[i]; q < l->start[i + 1]; q++) m[(size_t)i * (size_t)n + (size_t)l->index[q]] = 1;
    return m;
}

static void test_symmetry(void)
{
    int dim, kind, periodic, criterion;
    pcg32 random;
    pcg32_seed(&random, 14, 8);
    for (dim = 1; dim <= 3; dim++)
        for (kind = RANDOM; kind <= CLUSTERED; kind++)
            for (periodic = 0; periodic < 2; periodic++) {
                const sph_index n = dim == 3 ? 125 : 144;
                cloud c = make(kind, dim, n, 1, &random);
                const sph_real length = SPH_R(periodic), radius = SPH_R(3.0 / c.side < 0.5 ? 3.0 / c.side : 0.5);
                const sph_points x = sph_points_periodic(points(&c), length, length, length);
                sph_real *const R = random_radii(n, radius, 30.0, &random);
                problem p = problem_new(dim, x, x, sph_scalars_array(R), sph_scalars_array(R));
                unsigned char *m[CRITERIA];
                sph_index i, j;
                grid g;
                for (i = 0; kind == LATTICE && i < n; i++) /* many pairs at just the radius; of cells, and of a tree */
                    R[i] = SPH_R((double)radius / (double)(1 + i % 3 * (dim % 2 + 1)));
                g = grid_of(dim, x, p.source_radius);
                for (criterion = 0; criterion < CRITERIA; criterion++) {
                    lists l = lists_new("symmetry", &p, &g, criterion, 0);
                    m[criterion] = matrix_of(&l, n);
                    lists_free(&l);
                }
                for (criterion = 0; criterion < CRITERIA; criterion++) {
                    const int other = criterion == SPH_GATHER ? SPH_SCATTER : criterion == SPH_SCATTER ? SPH_GATHER : criterion;
                    long lost = 0;
                    now.criterion = criterion;
                    for (i = 0; i < n; i++)
                        for (j = 0; j < n; j++) lost += m[criterion][(size_t)i * (size_t)n + (size_t)j] != m[other][(size_t)j * (size_t)n + (size_t)i];
                    EXPECT(lost == 0); /* exactly: both rows have a pair, or none */
                }
                for (criterion = 0; criterion < CRITERIA; criterion++) free(m[criterion]);
                problem_free(&p);
                grid_free(&g);
                free(R);
                cloud_free(&c);
            }
}

static void test_targets(void)
{
    enum { N = 150, M = 170 };
    static const sph_index firsts[] = {1, 57, N - 1, N};
    int dim, periodic, criterion, turn;
    pcg32 random;
    pcg32_seed(&random, 21, 8);
    for (dim = 1; dim <= 3; dim++)
        for (periodic = 0; periodic < 3; periodic++) { /* not, all axes, the first */
            cloud c = make(RANDOM, dim, N, 1, &random), t = make(RANDOM, dim, M, 1, &random);
            sph_real *const coordinate[3] = {t.x, t.y, t.z};
            const sph_real radius = SPH_R(0.3);
            const sph_points x = sph_points_periodic(points(&c), SPH_R(periodic > 0), SPH_R(periodic == 1), SPH_R(periodic == 1));
            sph_points targets = x;
            sph_real *const R = random_radii(N, radius, 30.0, &random), *const S = random_radii(M, radius, 30.0, &random);
            grid g, one;
            sph_index i;
            int a;
            now.name = "targets";
            g = grid_of(dim, x, sph_scalars_array(R));
            one = grid_new(dim, x, radius);
            for (turn = 0; turn < 4; turn++) { /* the first of the sources */
                problem p;
                targets.n = firsts[turn];
                p = problem_new(dim, x, targets, sph_scalars_array(R), sph_scalars_array(R));
                for (criterion = 0; criterion < CRITERIA; criterion++) {
                    int flags;
                    for (flags = 0; flags < 8; flags++) check_lists("the first of the sources", &p, &g, criterion, flags);
                }
                problem_free(&p);
            }
            /* others, more than there are sources: among them; around them; far away; where sources are */
            for (turn = 0; turn < 4; turn++) {
                problem p;
                targets = points(&t);
                for (a = 0; a < dim; a++)
                    for (i = 0; i < M; i++) {
                        const sph_real *const source = a == 0 ? c.x : a == 1 ? c.y : c.z;
                        const double u = pcg32_uniform(&random);
                        const int wide = turn == 2 && i % 3 == 0 && !periodic;
                        coordinate[a][i] = turn == 3 ? source[i % N] : SPH_R(turn == 0 ? u : wide ? BY_PRECISION(1e200, 1e30) * (u - 0.5) : 8.0 * u - 3.5);
                    }
                if (periodic) targets = sph_points_periodic(targets, x.box.x, x.box.y, x.box.z);
                p = problem_new(dim, x, targets, sph_scalars_array(R), sph_scalars_array(S));
                for (criterion = 0; criterion < CRITERIA; criterion++) {
                    check_lists("other targets", &p, &g, criterion, SPH_LIST_FOREIGN);
                    check_lists("other targets", &p, &g, criterion, SPH_LIST_FOREIGN | SPH_LIST_SORTED);
                }
                check_lists("other targets of cells", &p, &one, SPH_GATHER, SPH_LIST_FOREIGN);
                p.targets.n = 3;
                p.source_radius = sph_scalars_same(&radius);
                check_lists("three other targets", &p, &one, SPH_LARGER, SPH_LIST_FOREIGN);
                problem_free(&p);
            }
            grid_free(&g);
            grid_free(&one);
            free(R);
            free(S);
            cloud_free(&c);
            cloud_free(&t);
        }
}

/* Targets that are the first sources, but have moved since the grid was built: none is its own neighbour, wherever its source was. */
static void test_moved(void)
{
    enum { N = 125 };
    int dim, way, periodic, criterion, flags;
    pcg32 random;
    pcg32_seed(&random, 4, 77);
    for (dim = 1; dim <= 3; dim++)
        for (way = 0; way < 3; way++) /* cells, hashed cells, a tree */
            for (periodic = 0; periodic < 2; periodic++) {
                const int hashed = way == 1;
                cloud c = make(LATTICE, dim, N, periodic, &random), t = cloud_new(dim, N);
                const double spacing = 1.0 / c.side, length = periodic ? (hashed && dim > 1 ? 1e4 : 1.0) : 0.0;
                const sph_real radius = SPH_R(1.7 * spacing), box = SPH_R(length);
                sph_real *const R = random_radii(N, radius, 30.0, &random);
                const sph_scalars radii = way == 2 ? sph_scalars_array(R) : sph_scalars_same(&radius);
                sph_real *const from[3] = {c.x, c.y, c.z}, *const to[3] = {t.x, t.y, t.z};
                problem p;
                grid g;
                sph_index i;
                int a;
                for (a = 0; a < dim; a++) {
                    if (hashed) from[a][N - 1] = SPH_R(7e3); /* most cells are empty */
                    for (i = 0; i < N; i++) to[a][i] = from[a][i] + SPH_R(3.0 * spacing * (2.0 * pcg32_uniform(&random) - 1.0));
                }
                if (periodic && hashed && dim == 1) from[0][N - 1] = SPH_R(0.999);
                g = grid_of(dim, sph_points_periodic(points(&c), box, box, box), radii);
                if (way < 2) EXPECT(!g.g.scattered);
                g.g.scattered = 0;
                p = problem_new(dim, sph_points_periodic(points(&c), box, box, box), sph_points_periodic(points(&t), box, box, box), radii, radii);
                if (dim > 1) EXPECT(g.g.hashed == hashed);
                EXPECT((g.g.levels > 0) == (way == 2));
                for (criterion = 0; criterion < CRITERIA; criterion++)
                    for (flags = 0; flags < 8; flags++) check_lists("moved since the grid was built", &p, &g, criterion, flags);
                problem_free(&p);
                grid_free(&g);
                free(R);
                cloud_free(&c);
                cloud_free(&t);
            }
}

/* ---- memory ---- */

static void test_capacity(void)
{
    enum { N = 30 };
    static const int some[] = {0, SPH_LIST_HALF, SPH_LIST_SELF | SPH_LIST_SORTED};
    int dim, kind, turn, criterion;
    pcg32 random;
    pcg32_seed(&random, 3, 3);
    for (dim = 1; dim <= 3; dim++)
        for (kind = RANDOM; kind <= COLLAPSED; kind++)
            for (turn = 0; turn < 3; turn++)
                for (criterion = turn; criterion < CRITERIA; criterion += 3) {
                    cloud c = make(kind, dim, N, 0, &random);
                    const sph_points x = turn == 2 ? sph_points_periodic(points(&c), SPH_R(1.125), SPH_R(0), SPH_R(1.125)) : points(&c);
                    const sph_real radius = SPH_R(0.3);
                    sph_real *const R = random_radii(N, radius, ratios_of_radii[kind % RATIOS], &random);
                    grid g = grid_of(dim, x, sph_scalars_array(R));
                    problem p = problem_new(dim, x, x, sph_scalars_array(R), sph_scalars_array(R));
                    const int64_t needed = check_lists("capacity", &p, &g, criterion, some[turn]);
                    guarded start = guarded_new((N + 1) * sizeof(sph_index)), index = guarded_new((size_t)needed * sizeof(sph_index));
                    int64_t capacity;
                    long lost = 0, written = 0;
                    for (capacity = 0; capacity < needed; capacity++) {
                        int64_t pairs = -1;
                        lost += call(&p, &g, criterion, some[turn], (sph_index *)guarded_memory(&start), (sph_index *)guarded_memory(&index), capacity,
                                     &pairs) != SPH_ERROR_CAPACITY;
                        lost += pairs != needed;
                        written += !guarded_unwritten_from(&index, (size_t)capacity * sizeof(sph_index)) || !guarded_intact(&start);
                    }
                    EXPECT(lost == 0);
                    EXPECT(written == 0);
                    if (needed > 0) {
                        int64_t pairs = -1;
                        EXPECT(call(&p, &g, criterion, some[turn], (sph_index *)guarded_memory(&start), (sph_index *)guarded_memory(&index), -1, &pairs) ==
                               SPH_ERROR_VALUE);
                        EXPECT(call(&p, &g, criterion, some[turn], (sph_index *)guarded_memory(&start), (sph_index *)guarded_memory(&index), needed, &pairs) ==
                               0);
                        EXPECT(pairs == needed);
                    }
                    EXPECT(guarded_intact(&start) && guarded_intact(&index));
                    free(start.base);
                    free(index.base);
                    free(R);
                    problem_free(&p);
                    grid_free(&g);
                    cloud_free(&c);
                }
}

/* Counted and filled rows are the same even where many pairs are at just the radius and rows are long: loops for full and for scarce memory must round alike, whatever the compiler
   makes of their sums (fused operations, say). */
static void test_tight(void)
{
    enum { SIDE = 12, N = SIDE * SIDE * SIDE, MULTIPLES = 7 };
    static const int some[] = {0, SPH_LIST_SELF, SPH_LIST_HALF};
    int multiple, turn, shuffled, periodic;
    sph_index *const start = (sph_index *)cloud_memory(N + 1, sizeof *start), *const counted = (sph_index *)cloud_memory(N + 1, sizeof *counted);
    sph_index *const seen = (sph_index *)cloud_memory(N, sizeof *seen);
    for (multiple = 5; multiple <= MULTIPLES; multiple++)
        for (turn = 0; turn < 3; turn++)
            for (shuffled = 0; shuffled < 2; shuffled++)
                for (periodic = 0; periodic < 2; periodic++) {
                    const double dx = 0.1 + 0.0137 * turn, shift = 1.7 * turn;
                    const sph_real radius = SPH_R(multiple * dx), length = SPH_R(periodic ? (multiple > 6 ? 14 : SIDE) * dx : 0.0);
                    const sph_scalars R = sph_scalars_same(&radius);
                    cloud c = cloud_new(3, N);
                    const sph_points x = sph_points_periodic(points(&c), length, length, length);
                    int64_t pairs = 0, filled = -1;
                    long wrong = 0;
                    guarded index;
                    sph_index *list, i, q;
                    grid g;
                    for (i = 0; i < N; i++) {
                        const int cell = shuffled ? (int)((int64_t)i * 7919 % N) : (int)i;
                        c.x[i] = SPH_R(cell % SIDE * dx + shift);
                        c.y[i] = SPH_R(cell / SIDE % SIDE * dx + 2.0 * shift);
                        c.z[i] = SPH_R(cell / SIDE / SIDE * dx - shift);
                        seen[i] = -1;
                    }
                    now.name = "tight";
                    now.dim = 3;
                    now.sources = now.targets = N;
                    now.criterion = SPH_GATHER;
                    now.flags = some[turn];
                    g = grid_new(3, x, radius);
                    EXPECT(sph_grid_count(3, &g.g, sph_query_of(x, SPH_GATHER, R, some[turn]), counted, &pairs) == 0);
                    index = guarded_new((size_t)pairs * sizeof *list);
                    list = (sph_index *)guarded_memory(&index);
                    if (EXPECT(sph_grid_lists(3, &g.g, sph_query_of(x, SPH_GATHER, R, some[turn]), start, list, pairs, &filled) == 0)) {
                        EXPECT(filled == pairs);
                        EXPECT(memcmp(start, counted, (N + 1) * sizeof *start) == 0);
                        for (i = 0; i < N; i++)
                            for (q = start[i]; q < start[i + 1]; q++) {
                                const int there = list[q] >= 0 && list[q] < N;
                                wrong += !there || seen[list[q]] == i;
                                if (there) seen[list[q]] = i;
                            }
                        EXPECT(wrong == 0);
                    }
                    EXPECT(guarded_intact(&index));
                    free(index.base);
                    grid_free(&g);
                    cloud_free(&c);
                }
    free(start);
    free(counted);
    free(seen);
}

static void test_workspace(void)
{
    static const sph_index sizes[] = {1, 2, 3, 7, 8, 15, 16, 17, 31, 64, 65, 100, 127, 333};
    enum { LARGEST = 333 };
    int dim, kind;
    size_t s;
    pcg32 random;
    pcg32_seed(&random, 6, 1);
    for (dim = 1; dim <= 3; dim++) {
        const size_t million = sph_grid_workspace(dim, 1000000);
        guarded work = guarded_new(sph_grid_workspace(dim, LARGEST));
        const sph_real radius = SPH_R(0.3);
        CHECK(sph_grid_workspace(dim, 1) > 0);
        CHECK(million < 1000000 * (8 * sizeof(sph_real) + 8 * sizeof(sph_index))); /* linear, and not many words a particle */
        CHECK(sph_grid_workspace(dim, 2000000) <= 2 * million + 4096 && sph_grid_workspace(dim, 2000000) >= 2 * million - 4096);
        for (s = 1; s < sizeof sizes / sizeof *sizes; s++) CHECK(sph_grid_workspace(dim, sizes[s]) >= sph_grid_workspace(dim, sizes[s - 1]));

        /* one workspace for clouds that grow, shrink and change their box; sizes that are no multiple of anything */
        for (kind = 0; kind < KINDS; kind++)
            for (s = 0; s < sizeof sizes / sizeof *sizes; s++) {
                const sph_index n = sizes[(s * 5 + (size_t)kind) % (sizeof sizes / sizeof *sizes)];
                const size_t needed = sph_grid_workspace(dim, n);
                cloud c = make(kind, dim, n, 0, &random);
                const sph_points x = s % 2 ? sph_points_periodic(points(&c), SPH_R(1.25), SPH_R(1.25), SPH_R(0)) : points(&c);
                sph_real *const R = random_radii(n, radius, 30.0, &random);
                const sph_scalars radii = s % 3 ? sph_scalars_same(&radius) : sph_scalars_array(R);
                problem p = problem_new(dim, x, x, radii, radii);
                size_t size;
                grid g;
                memset(&g.g, PATTERN, sizeof g.g);
                g.work = work;
                now.name = "workspace";
                EXPECT(sph_grid_build(dim, x, p.source_radius, guarded_memory(&work), needed - 1, &g.g) == SPH_ERROR_CAPACITY);
                if (kind == 0 && s == 0) EXPECT(guarded_unwritten(&work));
                for (size = needed; size <= needed + 9 && size <= work.bytes; size++) {
                    memset((unsigned char *)guarded_memory(&work) + size, PATTERN, work.bytes - size);
                    EXPECT(sph_grid_build(dim, x, p.source_radius, guarded_memory(&work), size, &g.g) == 0);
                    EXPECT(guarded_unwritten_from(&work, size)); /* what it did not get stays untouched */
                }
                check_lists("workspace", &p, &g, (int)s % CRITERIA, next_flags());
                EXPECT(guarded_unwritten_from(&work, size - 1));
                problem_free(&p);
                free(R);
                cloud_free(&c);
            }
        CHECK(guarded_intact(&work));
        free(work.base);
    }
}

/* ---- what is refused ---- */

static sph_real next_up(sph_real x) { return SPH_R(SPH_SINGLE ? (double)nextafterf((float)x, HUGE_VALF) : nextafter((double)x, HUGE_VAL)); }

static void test_radii(void)
{
    enum { N = 20 };
    /* the last two: their squares are no numbers, or 0, in sph_real */
    static const sph_real wrong[] = {SPH_R(0), SPH_R(-1), SPH_R(NAN), SPH_R(INFINITY), SPH_SINGLE ? SPH_R(1e-30) : SPH_R(1e-200), SPH_SINGLE ? SPH_R(1e30) : SPH_R(1e200)};
    int dim, criterion, foreign;
    pcg32 random;
    pcg32_seed(&random, 6, 1);
    for (dim = 1; dim <= 3; dim++)
        for (criterion = 0; criterion < CRITERIA; criterion++)
            for (foreign = 0; foreign < 2; foreign++) {
                cloud c = make(RANDOM, dim, N, 0, &random);
                const sph_real reach = SPH_R(0.3), half = SPH_R(0.15);
                const int flags = foreign ? SPH_LIST_FOREIGN : 0;
                sph_real R[N], S[N];
                size_t w;
                guarded start = guarded_new((N + 1) * sizeof(sph_index)), index = guarded_new(N * N * sizeof(sph_index));
                sph_index *const s = (sph_index *)guarded_memory(&start), *const list = (sph_index *)guarded_memory(&index);
                grid g;
                problem p;
                int64_t pairs = -5;
                size_t i;
                now.name = "radii";
                now.criterion = criterion;
                now.flags = flags;
                for (i = 0; i < N; i++) R[i] = S[i] = half;
                S[0] = reach;
                p = problem_new(dim, points(&c), points(&c), sph_scalars_array(S), sph_scalars_array(R));
                g = grid_of(dim, points(&c), p.source_radius);
                if (criterion != SPH_SCATTER) {
                    problem without = p;
                    without.target_radius.p = 0;
                    EXPECT(call(&without, &g, criterion, flags, s, list, N * N, &pairs) == SPH_ERROR_NULL);
                    EXPECT(call(&without, &g, criterion, flags, s, 0, 0, &pairs) == SPH_ERROR_NULL);
                }
                for (i = 0; i < N; i += N - 1)
                    for (w = 0; w < sizeof wrong / sizeof *wrong; w++) { /* of a target, of a source */
                        guarded work = guarded_new(sph_grid_workspace(dim, N));
                        sph_grid other;
                        const sph_real kept = S[i];
                        R[i] = wrong[w];
                        if (criterion != SPH_SCATTER) {
                            EXPECT(call(&p, &g, criterion, flags, s, list, N * N, &pairs) == SPH_ERROR_H);
                            EXPECT(call(&p, &g, criterion, flags, s, 0, 0, &pairs) == SPH_ERROR_H);
                        }
                        R[i] = half;
                        S[i] = wrong[w];
                        EXPECT(sph_grid_build(dim, points(&c), p.source_radius, guarded_memory(&work), work.bytes, &other) == SPH_ERROR_H);
                        S[i] = kept;
                        EXPECT(sph_grid_build(dim, points(&c), sph_scalars_same(&wrong[w]), guarded_memory(&work), work.bytes, &other) == SPH_ERROR_H);
                        EXPECT(sph_grid_build(dim, points(&c), sph_scalars_none(), guarded_memory(&work), work.bytes, &other) == SPH_ERROR_NULL);
                        EXPECT(guarded_unwritten(&work));
                        free(work.base);
                    }
                p.dim = dim % 3 + 1; /* not the grid's */
                EXPECT(call(&p, &g, criterion, flags, s, list, N * N, &pairs) == SPH_ERROR_DIM);
                EXPECT(call(&p, &g, criterion, flags, s, 0, 0, &pairs) == SPH_ERROR_DIM);
                p.dim = dim;
                EXPECT(pairs == 0 && guarded_unwritten(&start) && guarded_unwritten(&index));
                check_lists("radii", &p, &g, criterion, flags);
                /* far more than the grid was made for, up to all there are */
                R[N - 1] = SPH_R(32) * reach;
                check_lists("radii", &p, &g, criterion, flags);
                R[N - 1] = SPH_SINGLE ? SPH_R(1e15) : SPH_R(1e140);
                check_lists("radii", &p, &g, criterion, flags);
                R[N - 2] = SPH_SINGLE ? SPH_R(1e-15) : SPH_R(1e-140);
                check_lists("radii", &p, &g, criterion, flags);
                free(start.base);
                free(index.base);
                problem_free(&p);
                grid_free(&g);
                cloud_free(&c);
            }
}

static void test_box_limits(void)
{
    enum { N = 20 };
    int dim, axis;
    pcg32 random;
    pcg32_seed(&random, 6, 1);
    for (dim = 1; dim <= 3; dim++) {
        cloud c = make(RANDOM, dim, N, 0, &random);
        guarded work = guarded_new(sph_grid_workspace(dim, N));
        for (axis = dim; axis < 3; axis++) { /* an axis that the dimension does not have is not looked at */
            guarded other = guarded_new(work.bytes);
            const sph_real radius = SPH_R(0.3);
            sph_grid g;
            CHECK(sph_grid_build(dim, sph_points_periodic(points(&c), SPH_R(0), SPH_R(axis == 1 ? -1 : 0), SPH_R(axis == 2 ? -1 : 0)), sph_scalars_same(&radius),
                                 guarded_memory(&other), other.bytes, &g) == 0);
            free(other.base);
        }
        for (axis = 0; axis < dim; axis++) { /* half the box, and no more */
            const sph_real length = SPH_R(0.9), half = SPH_R(0.45), more = SPH_R(0.450001);
            const sph_points x =
                sph_points_periodic(points(&c), axis == 0 ? length : SPH_R(axis == 1 ? 2 : 0), axis == 1 ? length : SPH_R(0), axis == 2 ? length : SPH_R(3));
            sph_grid g;
            sph_index i;
            CHECK(sph_grid_build(dim, x, sph_scalars_same(&more), guarded_memory(&work), work.bytes, &g) == SPH_ERROR_BOX);
            CHECK(guarded_unwritten(&work));
            /* rounding may have made it a little longer: that is half the box, too, and nobody is a neighbour twice */
            for (i = 0; i < N; i++) (axis == 0 ? c.x : axis == 1 ? c.y : c.z)[i] = i % 2 ? half : SPH_R(0);
            search("half the box and a little", dim, x, (double)next_up(half));
            search("half the box", dim, x, (double)half);
        }
        free(work.base);
        cloud_free(&c);
    }
}

/* ---- order ---- */

static void test_order(void)
{
    int dim, kind, periodic;
    pcg32 random;
    pcg32_seed(&random, 8, 1);
    for (dim = 1; dim <= 3; dim++)
        for (kind = 0; kind < KINDS; kind++)
            for (periodic = 0; periodic < 2; periodic++) {
                enum { N = 321, STRIDE = 3 };
                cloud c = make(kind, dim, N, 0, &random);
                const sph_real length = SPH_R(periodic);
                sph_real *const R = random_radii(N, SPH_R(0.11), ratios_of_radii[kind % RATIOS], &random);
                grid g = grid_of(dim, sph_points_periodic(points(&c), length, length, length), sph_scalars_array(R));
                const sph_index *const order = sph_grid_permutation(&g.g);
                sph_index inverse[N], seen[N], s;
                sph_real packed[N], wide_in[STRIDE * N], wide_out[STRIDE * N];
                long lost = 0;
                memset(seen, 0, sizeof seen);
                for (s = 0; s < N; s++) {
                    if (order[s] < 0 || order[s] >= N) break;
                    seen[order[s]]++;
                }
                if (!EXPECT(s == N)) break; /* nothing to be done with it */
                for (s = 0; s < N; s++) lost += seen[s] != 1;
                CHECK(lost == 0); /* a permutation */

                CHECK(sph_permute_inverse(N, order, inverse) == 0);
                for (s = 0; s < N; s++) lost += inverse[order[s]] != s || order[inverse[s]] != s;
                CHECK(lost == 0);

                for (s = 0; s < STRIDE * N; s++) {
                    wide_in[s] = SPH_R(s);
                    wide_out[s] = SPH_R(-1);
                }
                CHECK(sph_permute(N, order, c.x, 1, packed) == 0);
                CHECK(sph_permute(N, order, wide_in + 1, STRIDE, wide_out + 1) == 0);
                for (s = 0; s < N; s++) {
                    lost += packed[s] != c.x[order[s]];
                    lost += wide_out[STRIDE * s + 1] != wide_in[STRIDE * order[s] + 1];
                    lost += wide_out[STRIDE * s] != SPH_R(-1) || wide_out[STRIDE * s + 2] != SPH_R(-1); /* in between */
                }
                CHECK(lost == 0);
                CHECK(sph_permute(N, inverse, packed, 1, wide_out) == 0); /* and back */
                CHECK(memcmp(wide_out, c.x, sizeof packed) == 0);
                grid_free(&g);
                free(R);
                cloud_free(&c);
            }
}

/* A grid that is told of the new numbers is the grid of the sorted particles. */
static void test_renumber(void)
{
    enum { N = 131 };
    const sph_real radius = SPH_R(0.23);
    int dim, kind, mask, criterion;
    pcg32 random;
    pcg32_seed(&random, 9, 1);
    CHECK(sph_grid_renumber(0) == SPH_ERROR_NULL);
    for (dim = 1; dim <= 3; dim++)
        for (kind = 0; kind < KINDS; kind++)
            for (mask = 0; mask < 1 << dim; mask++) {
                cloud c = make(kind, dim, N, 1, &random), sorted = cloud_new(dim, N);
                sph_real *const from[3] = {c.x, c.y, c.z}, *const to[3] = {sorted.x, sorted.y, sorted.z}, *const R = random_radii(N, radius, 30.0, &random), S[N];
                const sph_real box[3] = {SPH_R(mask & 1), SPH_R(mask >> 1 & 1), SPH_R(mask >> 2)};
                sph_points x;
                problem p;
                grid g;
                sph_index s;
                long moved = 0;
                int a;
                for (a = 0; a < dim; a++)
                    for (s = 0; s < N; s++) from[a][s] += SPH_R(mask >> a & 1 ? (double)(s % 3 - 1) : 0.0); /* other images, too */
                now.name = kind_name[kind];
                g = grid_new(dim, sph_points_periodic(points(&c), box[0], box[1], box[2]), radius);
                for (a = 0; a < dim; a++) CHECK(sph_permute(N, sph_grid_permutation(&g.g), from[a], 1, to[a]) == 0);
                CHECK(sph_grid_renumber(&g.g) == 0);
                for (s = 0; s < N; s++) moved += sph_grid_permutation(&g.g)[s] != s;
                CHECK(moved == 0);
                x = sph_points_periodic(points(&sorted), box[0], box[1], box[2]);
                p = problem_new(dim, x, x, sph_scalars_same(&radius), sph_scalars_same(&radius));
                for (criterion = 0; criterion < CRITERIA; criterion++) check_lists("renumbered", &p, &g, criterion, next_flags());
                problem_free(&p);
                grid_free(&g);
                g = grid_of(dim, sph_points_periodic(points(&c), box[0], box[1], box[2]), sph_scalars_array(R));
                for (a = 0; a < dim; a++) CHECK(sph_permute(N, sph_grid_permutation(&g.g), from[a], 1, to[a]) == 0);
                CHECK(sph_permute(N, sph_grid_permutation(&g.g), R, 1, S) == 0);
                CHECK(sph_grid_renumber(&g.g) == 0);
                p = problem_new(dim, x, x, sph_scalars_array(S), sph_scalars_array(S));
                for (criterion = 0; criterion < CRITERIA; criterion++) check_lists("renumbered, a radius for each", &p, &g, criterion, next_flags());
                problem_free(&p);
                grid_free(&g);
                free(R);
                cloud_free(&c);
                cloud_free(&sorted);
            }
}

/* cells and tree do bring neighbours together: in their order they are nearer, on the whole, than at random */
static void test_locality(void)
{
    int dim, tree;
    pcg32 random;
    pcg32_seed(&random, 8, 2);
    for (dim = 1; dim <= 3; dim++)
        for (tree = 0; tree < 2; tree++) {
        enum { N = 4000 };
        cloud c = make(RANDOM, dim, N, 0, &random);
        sph_real *const R = random_radii(N, SPH_R(dim == 1 ? 0.005 : 0.1), 30.0, &random);
        const sph_scalars radius = tree ? sph_scalars_array(R) : sph_scalars_same(&R[N / 2]);
        grid g = grid_of(dim, points(&c), radius);
        const sph_index *const order = sph_grid_permutation(&g.g);
        double before = 0.0, after = 0.0;
        sph_index s;
        for (s = 1; s < N; s++) {
            double p[3], q[3];
            cloud_position(&c, s - 1, p);
            cloud_position(&c, s, q);
            before += hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
            cloud_position(&c, order[s - 1], p);
            cloud_position(&c, order[s], q);
            after += hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
        }
        CHECK(after < 0.5 * before);
        grid_free(&g);
        free(R);
        cloud_free(&c);
    }
}

/* ---- when to build again ---- */

static void test_rebuild(void)
{
    enum { N = 33 };
    static const double third[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0}; /* of length 1 */
    int dim, axis, sign;
    pcg32 random;
    pcg32_seed(&random, 5, 5);
    for (dim = 1; dim <= 3; dim++) {
        cloud c = make(RANDOM, dim, N, 0, &random), d = make(RANDOM, dim, N, 0, &random);
        sph_real *const then[3] = {c.x, c.y, c.z}, *const after[3] = {d.x, d.y, d.z};
        const sph_real skin = SPH_R(0.5), half = SPH_R(0.25);
        const sph_points p = points(&c), q = points(&d), boxed = sph_points_periodic(q, SPH_R(2), SPH_R(4), SPH_R(8));
        sph_index i;
        int a, far_away;
        for (a = 0; a < dim; a++)
            for (i = 0; i < N; i++) after[a][i] = then[a][i];
        CHECK(sph_rebuild_due(dim, q, p, skin) == 0); /* nothing moved */
        CHECK(sph_rebuild_due(dim, q, p, SPH_R(1e-9)) == 0);
        CHECK(sph_rebuild_due(dim, boxed, p, skin) == 0);
        for (axis = 0; axis < dim; axis++)
            for (sign = -1; sign <= 1; sign += 2)
                for (i = 0; i < N; i += N / 2) {
                    const sph_real kept = then[axis][i], length = axis == 0 ? SPH_R(2) : axis == 1 ? SPH_R(4) : SPH_R(8);
                    then[axis][i] = SPH_R(0); /* where the threshold is exact */
                    after[axis][i] = SPH_R(sign) * half;
                    CHECK(sph_rebuild_due(dim, q, p, skin) == 0); /* just half the skin: not more */
                    after[axis][i] = SPH_R(sign) * next_up(half);
                    CHECK(sph_rebuild_due(dim, q, p, skin) == 1);
                    after[axis][i] = SPH_R(sign * 1e6);
                    CHECK(sph_rebuild_due(dim, q, p, skin) == 1);

                    after[axis][i] = SPH_R(sign) * (length - half); /* across the boundary, the shorter way */
                    CHECK(sph_rebuild_due(dim, boxed, p, skin) == 0);
                    CHECK(sph_rebuild_due(dim, q, p, skin) == 1);
                    after[axis][i] = SPH_R(sign) * (length - SPH_R(1.001) * half);
                    CHECK(sph_rebuild_due(dim, boxed, p, skin) == 1);
                    after[axis][i] = SPH_R(sign) * (SPH_R(5) * length + half);
                    CHECK(sph_rebuild_due(dim, boxed, p, skin) == 0);
                    after[axis][i] = SPH_R(sign) * length;
                    CHECK(sph_rebuild_due(dim, boxed, p, SPH_R(1e-3)) == 0);
                    for (far_away = 0; far_away < 3; far_away++) { /* more box lengths away than can be counted: now, then, at both times */
                        const sph_real where = SPH_R(sign) * (SPH_SINGLE ? SPH_R(1e30) : SPH_R(1e300));
                        then[axis][i] = far_away > 0 ? where : kept;
                        after[axis][i] = far_away != 1 ? where : kept;
                        CHECK(sph_rebuild_due(dim, boxed, p, skin) == SPH_ERROR_BOX);
                        CHECK(sph_rebuild_due(dim, q, p, skin) == (far_away < 2));
                    }
                    then[axis][i] = after[axis][i] = kept;
                }
        /* aslant: by the length, not by a component */
        for (a = 0; a < dim; a++) after[a][7] = SPH_R((double)then[a][7] + 0.249 * (dim == 3 ? third[a] : 1.0 / sqrt(dim)));
        CHECK(sph_rebuild_due(dim, q, p, skin) == 0);
        CHECK(sph_rebuild_due(dim, boxed, p, skin) == 0);
        for (a = 0; a < dim; a++) after[a][7] = SPH_R((double)then[a][7] + 0.251 * (dim == 3 ? third[a] : 1.0 / sqrt(dim)));
        CHECK(sph_rebuild_due(dim, q, p, skin) == 1);
        CHECK(sph_rebuild_due(dim, boxed, p, skin) == 1);
        cloud_free(&c);
        cloud_free(&d);
    }
}

/* Lists with a skin stay complete until sph_rebuild_due says so. */
/* moved by far more, and by far less, than half the skin, where the squares of both over- or underflow */
static void test_rebuild_extremes(void)
{
    const sph_real large = SPH_SINGLE ? SPH_R(1e30) : SPH_R(1e160), tiny = SPH_SINGLE ? SPH_R(1e-30) : SPH_R(1e-165);
    const sph_real lengths[2] = {large, tiny};
    int k, dim, axis;
    for (dim = 1; dim <= 3; dim++)
        for (axis = 0; axis < dim; axis++)
            for (k = 0; k < 2; k++) {
                sph_real then[3] = {SPH_R(0), SPH_R(0), SPH_R(0)}, now_at[3] = {SPH_R(0), SPH_R(0), SPH_R(0)};
                const sph_points p = sph_points_separate(1, then, then + 1, then + 2), q = sph_points_separate(1, now_at, now_at + 1, now_at + 2);
                now_at[axis] = lengths[k];
                CHECK(sph_rebuild_due(dim, q, p, SPH_R(1e-5) * lengths[k]) == 1);
                CHECK(sph_rebuild_due(dim, q, p, SPH_R(1.99) * lengths[k]) == 1);
                CHECK(sph_rebuild_due(dim, q, p, SPH_R(2.01) * lengths[k]) == 0);
                CHECK(sph_rebuild_due(dim, q, p, SPH_R(1e5) * lengths[k]) == 0);
                CHECK(sph_rebuild_due(dim, q, p, SPH_R(0)) == 1);
                CHECK(sph_rebuild_due(dim, p, p, SPH_R(0)) == 0);
                if (dim < 2) continue; /* along the diagonal: 1.41 times as far */
                now_at[(axis + 1) % dim] = -lengths[k];
                CHECK(sph_rebuild_due(dim, q, p, SPH_R(2.82) * lengths[k]) == 1);
                CHECK(sph_rebuild_due(dim, q, p, SPH_R(2.84) * lengths[k]) == 0);
            }
    { /* along the diagonal of a square of 0.01: farther than half of 0.025 */
        sph_real then[2] = {SPH_R(0), SPH_R(0)}, now_at[2] = {SPH_R(0.01), SPH_R(0.01)};
        CHECK(sph_rebuild_due(2, sph_points_separate(1, now_at, now_at + 1, 0), sph_points_separate(1, then, then + 1, 0),
                              SPH_R(0.025)) == 1);
    }
}

static void test_skin(void)
{
    enum { N = 150, STEPS = 40 };
    int dim;
    pcg32 random;
    pcg32_seed(&random, 15, 5);
    for (dim = 1; dim <= 3; dim++) {
        cloud c = make(RANDOM, dim, N, 1, &random), old = cloud_new(dim, N);
        sph_real *const coordinate[3] = {c.x, c.y, c.z}, *const then[3] = {old.x, old.y, old.z};
        const sph_real radius = SPH_R(0.2), skin = SPH_R(0.06), reach = radius + skin, one = SPH_R(1);
        const sph_points x = sph_points_periodic(points(&c), one, one, one);
        sph_index start[N + 1], *const index = (sph_index *)cloud_memory(N * N, sizeof *index), i, q;
        int step, a, builds = 0;
        long missed = 0;
        for (step = 0; step < STEPS; step++) {
            problem p;
            unsigned char *m;
            lists l;
            for (a = 0; step > 0 && a < dim; a++)
                for (i = 0; i < N; i++) coordinate[a][i] += SPH_R(0.006 * cloud_symmetric(&random));
            if (step == 0 || sph_rebuild_due(dim, x, points(&old), skin)) {
                grid g;
                int64_t pairs;
                const sph_scalars R = sph_scalars_same(&reach);
                for (a = 0; a < dim; a++) /* back into the box */
                    for (i = 0; i < N; i++) then[a][i] = coordinate[a][i] = SPH_R((double)coordinate[a][i] - floor((double)coordinate[a][i]));
                g = grid_new(dim, x, reach);
                CHECK(sph_grid_lists(dim, &g.g, sph_query_of(x, SPH_GATHER, R, 0), start, index, N * N, &pairs) == 0);
                grid_free(&g);
                builds++;
            }
            l.start = start;
            l.index = index;
            m = matrix_of(&l, N);
            p = problem_new(dim, x, x, sph_scalars_same(&radius), sph_scalars_same(&radius));
            for (i = 0; i < N; i++)
                for (q = 0; q < N; q++) missed += belongs(&p, SPH_GATHER, 0, i, q) == 1 && !m[(size_t)i * N + (size_t)q];
            free(m);
            problem_free(&p);
        }
        CHECK(missed == 0);
        CHECK(builds > 1 && builds < STEPS);
        free(index);
        cloud_free(&c);
        cloud_free(&old);
    }
}

/* ---- views other than separate arrays: the same lists ---- */

static void test_views(void)
{
    enum { N = 60, STRIDE = 5 };
    pcg32 g;
    int dim, periodic;
    pcg32_seed(&g, 21, 1);
    for (dim = 1; dim <= 3; dim++)
        for (periodic = 0; periodic < 2; periodic++) {
            cloud c = make(RANDOM, dim, N, 0, &g);
            sph_real xyz[3 * N], record[STRIDE * N];
            const sph_real radius = SPH_R(0.4), length = SPH_R(periodic);
            const sph_scalars R = sph_scalars_same(&radius), strided_R = sph_scalars_strided(record + 2, STRIDE);
            const sph_points separate = points(&c), interleaved = sph_points_interleaved(N, dim, xyz),
                             strided = sph_points_strided(N, record, record + 1, record + 3, STRIDE);
            sph_index start[3][N + 1], index[3][N * N];
            int64_t pairs[3];
            int i, way;
            memset(index, 0, sizeof index);
            for (i = 0; i < N; i++) {
                xyz[dim * i] = record[STRIDE * i] = c.x[i];
                if (dim > 1) xyz[dim * i + 1] = c.y[i];
                if (dim > 2) xyz[dim * i + 2] = c.z[i];
                record[STRIDE * i + 1] = dim > 1 ? c.y[i] : SPH_R(NAN); /* NaN: not looked at */
                record[STRIDE * i + 3] = dim > 2 ? c.z[i] : SPH_R(NAN);
                record[STRIDE * i + 2] = radius;
                record[STRIDE * i + 4] = SPH_R(NAN);
            }
            for (way = 0; way < 3; way++) {
                const sph_points x = sph_points_periodic(way == 0 ? separate : way == 1 ? interleaved : strided, length, length, length);
                grid grid_of = grid_new(dim, x, radius);
                CHECK(sph_grid_lists(dim, &grid_of.g, sph_query_of(x, SPH_LARGER, way == 2 ? strided_R : R, SPH_LIST_SORTED), start[way], index[way], N * N, &pairs[way]) == 0);
                CHECK(pairs[way] == pairs[0] && pairs[0] > 0);
                CHECK(memcmp(start[way], start[0], sizeof start[0]) == 0);
                CHECK(memcmp(index[way], index[0], (size_t)pairs[0] * sizeof index[0][0]) == 0);
                grid_free(&grid_of);
            }
            cloud_free(&c);
        }
}

/* ---- checksums ---- */

static uint64_t mix(uint64_t h)
{
    h = (h ^ (h >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    h = (h ^ (h >> 27)) * UINT64_C(0x94D049BB133111EB);
    return h ^ (h >> 31);
}

/* dim kind periodic criterion flags pairs-off-the-edge their-sum pairs in-order. The first seven are the same on all paths: they leave out the pairs that may be there or not,
   and the order of a row. All are the same for any number of threads. */
static void print_checksum(int dim, int kind, int periodic, sph_index n)
{
    pcg32 random;
    cloud c;
    sph_points x;
    sph_real radius, *R;
    grid g;
    int criterion;
    pcg32_seed(&random, (uint64_t)n, 2);
    c = make(kind, dim, n, 1, &random);
    x = periodic ? sph_points_periodic(points(&c), SPH_R(1), SPH_R(1), SPH_R(1)) : points(&c);
    radius = SPH_R(3.0 / c.side);
    R = random_radii(n, radius, ratios_of_radii[kind % RATIOS], &random);
    if (kind == LATTICE) { /* pairs at just the radius */
        sph_index i;
        for (i = 0; i < n; i++) R[i] = SPH_R((double)(1 + i % 3) / c.side);
    }
    g = grid_of(dim, x, sph_scalars_array(R));
    for (criterion = 0; criterion < CRITERIA; criterion++) {
        const int flags = (criterion + kind) % 8;
        const sph_scalars radii = sph_scalars_array(R);
        sph_index *const start = (sph_index *)cloud_memory((size_t)n + 1, sizeof *start), *index, i, q;
        int64_t pairs = 0, clear = 0, capacity;
        uint64_t sum = 0, ordered = 0;
        if (sph_grid_count(dim, &g.g, sph_query_of(x, criterion, radii, flags), start, &pairs) != 0) abort();
        capacity = pairs + pairs / 2; /* so that the parts of several threads are far apart */
        index = (sph_index *)cloud_memory((size_t)capacity, sizeof *index);
        if (sph_grid_lists(dim, &g.g, sph_query_of(x, criterion, radii, flags), start, index, capacity, &pairs) != 0) abort();
        for (i = 0; i < n; i++) {
            ordered = mix(ordered + (uint64_t)start[i + 1]);
            for (q = start[i]; q < start[i + 1]; q++) {
                const sph_index j = index[q];
                long double scale;
                const long double r = pair_distance(dim, x, i, x, j, &scale);
                ordered = mix(ordered + (uint64_t)j);
                if (within(r, support(criterion, (long double)R[i], (long double)R[j]), scale) != 1) continue;
                clear++;
                sum += mix(((uint64_t)i << 32) + (uint64_t)j);
            }
        }
        printf("%d %d %d %d %d %lld %016llx %lld %016llx\n", dim, kind, periodic, criterion, flags, (long long)clear, (unsigned long long)sum, (long long)pairs,
               (unsigned long long)ordered);
        free(start);
        free(index);
    }
    grid_free(&g);
    free(R);
    cloud_free(&c);
}

static int print_checksums(void)
{
    int dim, kind, periodic;
    for (dim = 1; dim <= 3; dim++)
        for (kind = RANDOM; kind <= CLUSTERED; kind++)
            for (periodic = 0; periodic < 2; periodic++) {
                print_checksum(dim, kind, periodic, dim == 1 ? 777 : dim == 2 ? 900 : 1000);
                if (kind == RANDOM || dim == 3) print_checksum(dim, kind, periodic, dim == 1 ? 5000 : dim == 2 ? 4900 : 3375);
            }
    return check_failed != 0;
}

int main(int count, char **word)
{
    if (CHECKSUMS_ONLY || (count > 1 && strcmp(word[1], "checksums") == 0)) return print_checksums();
    test_clouds();
    test_rounding();
    test_few();
    test_empty_domain();
    test_boxes();
    test_sharp();
    test_flags();
    test_symmetry();
    test_targets();
    test_moved();
    test_capacity();
    test_tight();
    test_workspace();
    test_radii();
    test_box_limits();
    test_order();
    test_renumber();
    test_locality();
    test_rebuild();
    test_rebuild_extremes();
    test_skin();
    test_views();
    return check_report("test_neighbors");
}
