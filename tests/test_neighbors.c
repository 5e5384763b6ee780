/* SPDX-License-Identifier: MIT */
/*
 * test_neighbors.c - the neighbour search against all pairs, on clouds of every kind, and nothing written where it must not be.
 */
#define SPH_FN static inline /* one copy of each function is enough */

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

/* ---- memory with guards on both sides ---- */

enum { GUARD = 64 };

typedef struct guarded {
    unsigned char *base;
    size_t bytes;
} guarded;

static guarded guarded_new(size_t bytes)
{
    guarded g;
    g.base = (unsigned char *)cloud_memory(bytes + 2 * GUARD, 1);
    g.bytes = bytes;
    memset(g.base, 0x5A, bytes + 2 * GUARD);
    return g;
}
static void *guarded_memory(const guarded *g) { return g->base + GUARD; }
static int guarded_intact(const guarded *g)
{
    size_t i;
    for (i = 0; i < GUARD; i++)
        if (g->base[i] != 0x5A || g->base[GUARD + g->bytes + i] != 0x5A) return 0;
    return 1;
}
static int guarded_unwritten(const guarded *g)
{
    size_t i;
    for (i = 0; i < g->bytes; i++)
        if (g->base[GUARD + i] != 0x5A) return 0;
    return guarded_intact(g);
}

/* ---- one search ---- */

static int near_by_force(int dim, const cloud *c, sph_index i, sph_index j, sph_real radius)
{
    sph_vec e;
    e.x = c->x[i] - c->x[j];
    e.y = c->y[i] - c->y[j];
    e.z = c->z[i] - c->z[j];
    return i != j && sph_length(dim, e) < radius;
}

/* Returns the number of pairs. */
static int64_t check_search(const char *name, const cloud *c, double length)
{
    const int dim = c->dim;
    const sph_real radius = SPH_R(length);
    const sph_index n = c->n;
    const sph_points x = sph_points_separate(n, c->x, dim > 1 ? c->y : 0, dim > 2 ? c->z : 0);
    guarded work = guarded_new(sph_neighbors_workspace(n)), start = guarded_new(((size_t)n + 1) * sizeof(sph_index)), index, count;
    sph_index *const s = (sph_index *)guarded_memory(&start);
    sph_index *list, i, j, p;
    unsigned char *const seen = (unsigned char *)cloud_memory((size_t)n, 1);
    int64_t pairs = -1, expected = 0;
    long missed = 0, extra = 0, twice = 0, none = 0;
    unsigned char *copy;

    count = guarded_new(sizeof pairs);
    if (!check_count(sph_neighbors_count(dim, x, radius, guarded_memory(&work), s, &pairs) == 0)) fprintf(stderr, "%s: not counted\n", name);
    CHECK(s[0] == 0);
    CHECK(s[n] == pairs);
    CHECK(guarded_intact(&work) && guarded_intact(&start) && guarded_unwritten(&count));
    copy = (unsigned char *)cloud_memory(work.bytes, 1);
    memcpy(copy, guarded_memory(&work), work.bytes);

    index = guarded_new((size_t)pairs * sizeof(sph_index));
    list = (sph_index *)guarded_memory(&index);
    if (pairs > 0) {
        CHECK(sph_neighbors_fill(dim, x, radius, guarded_memory(&work), s, list, pairs - 1) == SPH_ERROR_CAPACITY);
        CHECK(sph_neighbors_fill(dim, x, radius, guarded_memory(&work), s, list, 0) == SPH_ERROR_CAPACITY);
        CHECK(guarded_unwritten(&index));
    } else CHECK(sph_neighbors_fill(dim, x, radius, guarded_memory(&work), s, 0, 0) == 0);
    CHECK(sph_neighbors_fill(dim, x, radius, guarded_memory(&work), s, list, pairs) == 0);
    CHECK(guarded_intact(&index) && guarded_intact(&work) && guarded_intact(&start));
    CHECK(memcmp(copy, guarded_memory(&work), work.bytes) == 0); /* it reads the workspace only */

    for (i = 0; i < n; i++) {
        memset(seen, 0, (size_t)n);
        for (p = s[i]; p < s[i + 1]; p++) {
            if (list[p] < 0 || list[p] >= n) {
                none++;
                continue;
            }
            twice += seen[list[p]];
            seen[list[p]] = 1;
        }
        for (j = 0; j < n; j++) {
            const int want = near_by_force(dim, c, i, j, radius);
            expected += want;
            missed += want && !seen[j];
            extra += !want && seen[j];
        }
    }
    if (!check_count(missed == 0 && extra == 0 && twice == 0 && none == 0 && pairs == expected))
        fprintf(stderr, "test_neighbors.c: failed: %s in %dD, %ld particles, radius %g: %ld missed, %ld too many, %ld twice, %ld out of range; %ld pairs, not %ld\n", name, dim, (long)n,
                length, missed, extra, twice, none, (long)pairs, (long)expected);
    free(work.base);
    free(start.base);
    free(index.base);
    free(count.base);
    free(copy);
    free(seen);
    return pairs;
}

/* ---- clouds in the unit box, moved and stretched afterwards ---- */

enum { RANDOM, LATTICE, CLUSTERED, COINCIDENT, COLLINEAR, CLUMPS, PLANES, KINDS };
static const char *const kind_name[KINDS] = {"random", "lattice", "clustered", "coincident", "collinear", "two clumps", "planes"};

static cloud make(int kind, int dim, sph_index n, pcg32 *g)
{
    cloud c = cloud_new(dim, n);
    sph_real *const coordinate[3] = {c.x, c.y, c.z};
    const int side = dim == 1 ? (int)n : dim == 2 ? (int)ceil(sqrt((double)n)) : (int)ceil(cbrt((double)n));
    sph_index i;
    int a;
    for (i = 0; i < n; i++) {
        const int cell[3] = {(int)i % side, (int)i / side % side, (int)i / side / side};
        const double along = pcg32_uniform(g);
        for (a = 0; a < dim; a++) {
            const double u = pcg32_uniform(g);
            double v = u;
            if (kind == LATTICE) v = side > 1 ? (double)cell[a] / (side - 1) : 0.0;
            if (kind == CLUSTERED) v = u * u * u * u * u;
            if (kind == COINCIDENT) v = 0.625;
            if (kind == COLLINEAR) v = (1.0 + a) * along / 3.0;
            if (kind == CLUMPS) v = 1e-12 * u + (i % 2 ? 1.0 : 0.0);
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

static void test_clouds(void)
{
    static const double radii[] = {0.07, 0.2, 0.33333333333333333, 0.5, 1.0};
    pcg32 g;
    int kind, dim;
    size_t r;
    pcg32_seed(&g, 4, 4);
    for (dim = 1; dim <= 3; dim++)
        for (kind = 0; kind < KINDS; kind++) {
            const sph_index n = dim == 1 ? 101 : dim == 2 ? 256 : 343;
            cloud c = make(kind, dim, n, &g);
            int64_t least = -1, most = -1;
            for (r = 0; r < sizeof radii / sizeof *radii; r++) most = check_search(kind_name[kind], &c, radii[r]);
            CHECK(most > 0);
            least = check_search(kind_name[kind], &c, 1e-30);
            CHECK(least == (kind == COINCIDENT ? (int64_t)n * (n - 1) : least)); /* coincident particles are neighbours at any radius */
            CHECK(check_search(kind_name[kind], &c, 50.0) == (int64_t)n * (n - 1)); /* all of them */
            move(&c, 3.0, -7.0); /* negative coordinates */
            check_search(kind_name[kind], &c, 0.6);
            move(&c, 1e-3, 0.25); /* near together, and not at the origin */
            check_search(kind_name[kind], &c, 7e-4);
            move(&c, 1e6, -3.0);
            check_search(kind_name[kind], &c, 600.0);
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
            check_search("spacing divides the radius", &c, m * c.dx);
            check_search("spacing divides the radius", &c, (double)((c.x[m] - c.x[0])));
            move(&c, 0.3, 0.1);
            check_search("spacing divides the radius, moved", &c, 0.3 * m * c.dx);
            move(&c, 1.0, -20.0);
            check_search("spacing divides the radius, far", &c, 0.3 * m * c.dx);
            cloud_free(&c);
        }
    for (dim = 2; dim <= 3; dim++)
        for (side = 5; side <= (dim == 2 ? 21 : 8); side += 3) {
            cloud c = cloud_lattice(dim, side, 1.0, 0.0, 1);
            check_search("spacing divides the radius", &c, c.dx);
            check_search("spacing divides the radius", &c, 2.0 * c.dx);
            move(&c, 0.3, 0.1);
            check_search("spacing divides the radius, moved", &c, 0.6 * c.dx);
            cloud_free(&c);
        }
}

static void test_few(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_new(dim, 1);
        CHECK(check_search("one", &c, 1.0) == 0);
        cloud_free(&c);

        c = cloud_new(dim, 2);
        c.x[1] = SPH_R(0.5);
        CHECK(check_search("two", &c, 1.0) == 2);
        CHECK(check_search("two", &c, 0.5) == 0); /* nearer than the radius, not as near */
        CHECK(check_search("two", &c, 0.50001) == 2);
        CHECK(check_search("two", &c, 0.1) == 0);
        c.x[1] = SPH_R(-1e12); /* nothing in between */
        CHECK(check_search("two", &c, 0.1) == 0);
        CHECK(check_search("two", &c, 2e12) == 2);
        cloud_free(&c);
    }
}

/* Two clumps 1e12 apart: memory and time must not follow the empty domain. */
static void test_empty_domain(void)
{
    pcg32 g;
    int dim;
    pcg32_seed(&g, 9, 9);
    for (dim = 1; dim <= 3; dim++) {
        cloud c = make(RANDOM, dim, 200, &g);
        int64_t together, apart;
        sph_index i;
        for (i = 100; i < 200; i++) c.x[i] += SPH_R(3); /* two boxes that do not touch */
        together = check_search("two boxes", &c, 0.25);
        for (i = 100; i < 200; i++) {
            c.x[i] = SPH_R(1e12); /* where nothing but multiples of the spacing of numbers is left */
            if (dim > 1) c.y[i] = SPH_R(-1e12);
            if (dim > 2) c.z[i] = SPH_R(1e12);
        }
        apart = check_search("far apart", &c, 0.25);
        CHECK(together > 0 && apart >= 100 * 99);
        cloud_free(&c);
    }
}

/* Views other than separate arrays, and lists in order of nothing in particular but the same every time. */
static void test_views(void)
{
    enum { N = 60, STRIDE = 5 };
    pcg32 g;
    int dim;
    pcg32_seed(&g, 21, 1);
    for (dim = 1; dim <= 3; dim++) {
        cloud c = make(RANDOM, dim, N, &g);
        sph_real xyz[3 * N], record[STRIDE * N];
        const sph_points separate = sph_points_separate(N, c.x, c.y, c.z), interleaved = sph_points_interleaved(N, dim, xyz),
                         strided = sph_points_strided(N, record, record + 1, record + 3, STRIDE);
        void *const work = cloud_memory(sph_neighbors_workspace(N), 1);
        sph_index start[3][N + 1], index[3][N * N];
        int64_t pairs[3];
        int i, way;
        memset(index, 0, sizeof index);
        for (i = 0; i < N; i++) {
            xyz[dim * i] = record[STRIDE * i] = c.x[i];
            if (dim > 1) xyz[dim * i + 1] = c.y[i];
            if (dim > 2) xyz[dim * i + 2] = c.z[i];
            record[STRIDE * i + 1] = c.y[i];
            record[STRIDE * i + 3] = c.z[i];
            record[STRIDE * i + 2] = record[STRIDE * i + 4] = SPH_R(NAN); /* not looked at */
        }
        for (way = 0; way < 3; way++) {
            const sph_points x = way == 0 ? separate : way == 1 ? interleaved : strided;
            CHECK(sph_neighbors_count(dim, x, SPH_R(0.4), work, start[way], &pairs[way]) == 0);
            CHECK(sph_neighbors_fill(dim, x, SPH_R(0.4), work, start[way], index[way], N * N) == 0);
            CHECK(pairs[way] == pairs[0] && pairs[0] > 0);
            CHECK(memcmp(start[way], start[0], sizeof start[0]) == 0);
            CHECK(memcmp(index[way], index[0], sizeof index[0]) == 0);
        }
        free(work);
        cloud_free(&c);
    }
}

int main(void)
{
    test_clouds();
    test_rounding();
    test_few();
    test_empty_domain();
    test_views();
    return check_report("test_neighbors");
}
