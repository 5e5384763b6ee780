/* SPDX-License-Identifier: MIT */
/*
 * test_capacity.c - lists on memory of every size: whatever the room, the number of threads and the order of the
 * particles, the same lists and the same number of pairs come back, and what fits is never refused.
 *
 * Clouds whose particles have very different numbers of neighbours, so that the share of one thread overflows although
 * the whole room suffices; and collapsed ones, whose rows are as long as the cloud. Compared with all pairs. Positions
 * and radii are such that no distance is near to a radius: no pair depends on rounding. Compiled with -fopenmp
 * -DSPH_OPENMP=1 it runs all of it with 1, 2, 3 and 7 threads.
 */
#define SPH_FN static inline /* one copy of each function is enough */
#define SPHI_CROWDED 8       /* so that small clouds have crowded cells, */
#define SPHI_LEAF 2          /* and more leaves than a target has room for */
#include <assert.h>
#define SPH_ASSERT(x) assert(x) /* what one pass of the search guarantees to the next */

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <string.h>
#include <time.h>

enum { CRITERIA = 4, GUARD = 64, WIDE = 65536 }; /* WIDE: threads share the closing of gaps as wide as that */
static const sph_index guard_value = 12345;

typedef struct sample {
    const char *name;
    int dim;
    sph_index n;
    sph_real *x, *y, *z, *R;
    sph_real box[3]; /* 0: open */
} sample;

static sample sample_new(const char *name, int dim, sph_index n)
{
    sample s;
    s.name = name;
    s.dim = dim;
    s.n = n;
    s.x = (sph_real *)cloud_memory((size_t)n, sizeof *s.x);
    s.y = (sph_real *)cloud_memory((size_t)n, sizeof *s.y);
    s.z = (sph_real *)cloud_memory((size_t)n, sizeof *s.z);
    s.R = (sph_real *)cloud_memory((size_t)n, sizeof *s.R);
    s.box[0] = s.box[1] = s.box[2] = SPH_R(0);
    return s;
}
static void sample_free(sample *s)
{
    free(s->x);
    free(s->y);
    free(s->z);
    free(s->R);
}
static sph_points sample_points(const sample *s)
{
    return sph_points_periodic(sph_points_separate(s->n, s->x, s->y, s->z), s->box[0], s->box[1], s->box[2]);
}
/* Radii of each particle: squares of lattice distances are whole numbers (or sixteenths), and none of these squares is
   near to one, nor is that of the mean of two of them. */
static void sample_radii(sample *s)
{
    sph_index i;
    for (i = 0; i < s->n; i++) s->R[i] = SPH_R(i % 3 == 0 ? 2.33 : i % 3 == 1 ? 2.6 : 2.73);
}
static void sample_swap(sph_real *a, sph_index i, sph_index j)
{
    const sph_real kept = a[i];
    a[i] = a[j];
    a[j] = kept;
}
static void sample_shuffle(sample *s, pcg32 *random)
{
    sph_index i;
    for (i = s->n - 1; i > 0; i--) {
        const sph_index j = (sph_index)(pcg32_uniform(random) * (double)(i + 1));
        sample_swap(s->x, i, j);
        sample_swap(s->y, i, j);
        sample_swap(s->z, i, j);
        sample_swap(s->R, i, j);
    }
}

/* In lattice order a block of spacing 1 and above it one of spacing 2, of as many particles. */
static sample two_spacings(int dim, int side)
{
    const sph_index block = (sph_index)(dim == 3 ? side * side * side : side * side);
    sample s = sample_new("two spacings", dim, 2 * block);
    sph_index i;
    for (i = 0; i < s.n; i++) {
        const int j = (int)(i % block), above = i >= block, spacing = above ? 2 : 1;
        s.x[i] = SPH_R(spacing * (j % side));
        s.y[i] = SPH_R(spacing * (j / side % side));
        s.z[i] = SPH_R(spacing * (j / side / side));
        if (above && dim == 3) s.z[i] += SPH_R(side + 1);
        if (above && dim == 2) s.y[i] += SPH_R(side + 1);
    }
    sample_radii(&s);
    return s;
}

/* On a line, the second half twice as dense as the first: with two threads and a third more room than needed
   the rows of the second half are moved down by less than their length, which takes several steps. */
static sample denser_half(sph_index half)
{
    sample s = sample_new("a denser half", 1, 2 * half);
    sph_index i;
    for (i = 0; i < half; i++) {
        s.x[i] = SPH_R(0.125) * SPH_R(i);
        s.x[half + i] = SPH_R(0.125) * SPH_R(half) + SPH_R(0.0625) * SPH_R(i);
    }
    sample_radii(&s);
    return s;
}

/* A third of the particles collapsed into six places, the others on points of a lattice of spacing 1/4. A box
   is longer by `more` along each axis than along the one before, so that none can be taken for another. */
static sample collapsed(int dim, sph_index n, double box, double more, pcg32 *random)
{
    sample s = sample_new(box > 0.0 ? "collapsed, periodic" : "collapsed", dim, n);
    sph_index i;
    for (i = 0; i < 3; i++) s.box[i] = SPH_R(box + more * (double)i);
    for (i = 0; i < n; i++) {
        sph_real *const coordinate[3] = {s.x, s.y, s.z};
        int a;
        for (a = 0; a < dim; a++) {
            const int places = i % 3 == 0 ? (int)(i % 6) * 7 : (int)(64.0 * pcg32_uniform(random));
            coordinate[a][i] = SPH_R(0.25) * SPH_R(places % 64);
        }
    }
    sample_radii(&s);
    return s;
}

/* ---- all pairs ---- */

static double component(sph_real a, sph_real b, sph_real box)
{
    const double d = fabs((double)a - (double)b), length = (double)box;
    return length > 0.0 && d > 0.5 * length ? length - d : d;
}
static int near(const sample *s, int criterion, sph_index i, sph_index j)
{
    const double dx = component(s->x[i], s->x[j], s->box[0]), dy = component(s->y[i], s->y[j], s->box[1]);
    const double dz = component(s->z[i], s->z[j], s->box[2]);
    const double a = (double)s->R[i], b = (double)s->R[j];
    const double R = criterion == SPH_GATHER ? a : criterion == SPH_SCATTER ? b : criterion == SPH_LARGER ? (a > b ? a : b) : 0.5 * (a + b);
    return dx * dx + dy * dy + dz * dz < R * R;
}
static int64_t all_pairs(const sample *s, int criterion, int flags, sph_index *start, sph_index *index)
{
    int64_t pairs = 0;
    sph_index i, j;
    start[0] = 0;
    for (i = 0; i < s->n; i++) {
        for (j = flags & SPH_LIST_HALF ? i + 1 : 0; j < s->n; j++)
            if (near(s, criterion, i, j) && (i != j || flags & SPH_LIST_SELF)) index[pairs++] = j;
        start[i + 1] = (sph_index)pairs;
    }
    return pairs;
}

/* ---- the search with any room and any number of threads ---- */

static void threads(int count)
{
#if SPH_OPENMP
    omp_set_num_threads(count);
#else
    (void)count;
#endif
}

static void failure(const sample *s, int criterion, int flags, int count, int64_t capacity, int64_t pairs, const char *what)
{
    fprintf(stderr, "%s, %dD, criterion %d, flags %d, %d threads, room %lld for %lld pairs: %s\n", s->name, s->dim, criterion, flags,
            count, (long long)capacity, (long long)pairs, what);
}

static void check_rooms(const sample *s, const sph_grid *g, int criterion, int flags)
{
    static const int counts[] = {1, 2, 3, 7}, percents[] = {99, 100, 145, 90, 95, 105, 110, 115, 120, 130, 140};
    enum { ALONE = 3, ROOMS = sizeof percents / sizeof *percents }; /* one thread has no shares that could overflow */
    const size_t n = (size_t)s->n, most = n * n;
    sph_index *const wanted_start = (sph_index *)cloud_memory(n + 1, sizeof *wanted_start);
    sph_index *const wanted = (sph_index *)cloud_memory(most, sizeof *wanted);
    const int64_t pairs = all_pairs(s, criterion, flags & ~SPH_LIST_SORTED, wanted_start, wanted);
    sph_index *const start = (sph_index *)cloud_memory(n + 1, sizeof *start);
    const size_t room = (size_t)(pairs + pairs / 2) + WIDE + 2 * GUARD;
    sph_index *const index = (sph_index *)cloud_memory(room, sizeof *index), *const first = (sph_index *)cloud_memory(room, sizeof *first);
    const sph_scalars R = sph_scalars_array(s->R);
    int t, k;
    for (t = 0; t < (SPH_OPENMP ? 4 : 1); t++)
        for (k = 0; k < (t == 0 ? ALONE : ROOMS); k++) {
            const int percent = percents[k];
            const int64_t extra = percent > 140 ? WIDE : 0;
            const int64_t capacity = percent == 99 ? pairs - 1 : pairs * percent / 100 + extra;
            const size_t end = (size_t)capacity + GUARD;
            const char *wrong = 0;
            int64_t found = -1;
            sph_index answer, i, q;
            size_t p;
            for (p = 0; p < end; p++) index[p] = guard_value;
            threads(counts[t]);
            answer = sph_grid_lists(s->dim, g, sph_query_of(sample_points(s), criterion, R, flags), start, index, capacity, &found);
            if (found != pairs) wrong = "the number of pairs is wrong";
            else if (answer != (capacity < pairs ? SPH_ERROR_CAPACITY : 0)) wrong = "the answer is wrong";
            for (p = (size_t)capacity; p < end; p++)
                if (index[p] != guard_value) wrong = "written beyond the room";
            if (answer == 0 && !wrong && memcmp(start, wanted_start, (n + 1) * sizeof *start) != 0) wrong = "a row of a wrong length";
            if (answer == 0 && !wrong && flags & SPH_LIST_SORTED)
                wrong = memcmp(index, wanted, (size_t)pairs * sizeof *index) != 0 ? "a row of wrong neighbours" : 0;
            else if (answer == 0 && !wrong) { /* in any order, but always in the same */
                if (percent == 100 && t == 0) {
                    memcpy(first, index, (size_t)pairs * sizeof *index);
                    for (i = 0; i < s->n; i++) {
                        for (q = start[i]; q < start[i + 1]; q++)
                            if (index[q] < 0 || index[q] >= s->n || !near(s, criterion, i, index[q])) wrong = "an entry that is no neighbour";
                        sphi_sort(index + start[i], start[i + 1] - start[i], 0);
                    }
                    if (!wrong && memcmp(index, wanted, (size_t)pairs * sizeof *index) != 0) wrong = "a row of wrong neighbours";
                } else if (memcmp(index, first, (size_t)pairs * sizeof *index) != 0) wrong = "another list than with just enough room and one thread";
            }
            if (!check_count(!wrong)) failure(s, criterion, flags, counts[t], capacity, pairs, wrong);
        }
    threads(1);
    free(wanted_start);
    free(wanted);
    free(start);
    free(index);
    free(first);
}

static void check_sample(const sample *s)
{
    static const int flags[CRITERIA] = {0, SPH_LIST_SORTED, SPH_LIST_HALF, SPH_LIST_SELF | SPH_LIST_SORTED};
    const size_t size = sph_grid_workspace(s->dim, s->n);
    void *const work = cloud_memory(size, 1);
    int criterion, way;
    for (way = 0; way < 3; way++) {
        const sph_real one = SPH_R(2.6);
        sph_index i;
        sph_grid g;
        for (i = 0; way == 1 && i < s->n; i++) s->R[i] = one;                               /* one radius for all: other loops of the search */
        for (i = 0; way == 2 && i < s->n; i++) s->R[i] = SPH_R(i % 5 == 1 ? 0.21 : 2.73);   /* a tree */
        CHECK(sph_grid_build(s->dim, sample_points(s), way == 1 ? sph_scalars_same(&one) : sph_scalars_array(s->R), work, size, &g) == 0);
        CHECK((g.levels > 0) == (way == 2));
        for (criterion = 0; criterion < CRITERIA; criterion++) check_rooms(s, &g, criterion, flags[(criterion + way) % CRITERIA]);
    }
    free(work);
}

/* in lattice order, in any order (rows are then placed in the order of the cells), and with one particle so far away that
   the cells are hashed */
static void check_orders(sample s, pcg32 *random)
{
    check_sample(&s);
    sample_radii(&s);
    sample_shuffle(&s, random);
    check_sample(&s);
    if (!(s.box[0] > SPH_R(0))) {
        sample_radii(&s);
        s.x[s.n / 2] = SPH_R(1e5);
        check_sample(&s);
    }
    sample_free(&s);
}

static void test_rooms(void)
{
    sample dense = denser_half(600);
    pcg32 random;
    pcg32_seed(&random, 15, 1);
    check_orders(two_spacings(2, 20), &random);
    check_orders(two_spacings(3, 7), &random);
    check_sample(&dense);
    sample_free(&dense);
    check_orders(collapsed(1, 300, 0.0, 0.0, &random), &random);
    check_orders(collapsed(2, 700, 0.0, 0.0, &random), &random);
    check_orders(collapsed(3, 700, 0.0, 0.0, &random), &random);
    check_orders(collapsed(2, 700, 17.0, -0.5, &random), &random);
    check_orders(collapsed(3, 700, 17.0, -0.5, &random), &random);
    check_orders(collapsed(3, 700, 16.0, 0.5, &random), &random);
}

/* ---- more pairs than any memory holds, or than sph_index can count: an answer, and soon ---- */

/* coincident particles, `extra` of the others elsewhere */
static void check_collapse(int dim, sph_index n, sph_index apart, int flags)
{
    enum { ROOM = 1000 };
    sample s = sample_new("coincident", dim, n);
    const sph_real radius = SPH_R(0.1);
    const sph_scalars R = sph_scalars_same(&radius);
    const size_t size = sph_grid_workspace(dim, n);
    void *const work = cloud_memory(size, 1);
    sph_index *const start = (sph_index *)cloud_memory((size_t)n + 1, sizeof *start);
    sph_index *const index = (sph_index *)cloud_memory(ROOM + GUARD, sizeof *index);
    const int64_t crowd = n - apart, full = crowd * (crowd - 1), pairs = flags & SPH_LIST_HALF ? full / 2 : full;
    const int countable = pairs <= SPHI_INDEX_MAX;
    const clock_t before = clock();
    int64_t found[3] = {-1, -1, -1}, room;
    sph_grid g;
    sph_index i;
    int k, written = 0;
    for (i = 0; i < n; i++) {
        s.x[i] = i < apart ? SPH_R(2 + i) : SPH_R(0.7);
        s.y[i] = s.z[i] = SPH_R(0.3);
    }
    for (i = 0; i < ROOM + GUARD; i++) index[i] = guard_value;
    CHECK(sph_grid_build(dim, sample_points(&s), R, work, size, &g) == 0);
    for (k = 0; k < 3; k++) {
        const sph_index answer = countable ? SPH_ERROR_CAPACITY : SPH_ERROR_PAIRS;
        room = k == 0 ? ROOM : k == 1 ? 1 : 0;
        threads(k == 1 ? 3 : 1);
        CHECK(sph_grid_lists(dim, &g, sph_query_of(sample_points(&s), SPH_LARGER, R, flags), start, room > 0 ? index : 0, room, &found[k]) == answer);
    }
    threads(1);
    for (i = ROOM; i < ROOM + GUARD; i++) written |= index[i] != guard_value;
    CHECK(!written);
    CHECK(countable ? found[0] == pairs : found[0] >= pairs);
    CHECK(found[1] == found[0] && found[2] == found[0]);
    CHECK((double)(clock() - before) / CLOCKS_PER_SEC < 20.0); /* n^2 steps would take minutes */
    free(work);
    free(start);
    free(index);
    sample_free(&s);
}

static void test_collapses(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        check_collapse(dim, 30000, 0, 0);
        check_collapse(dim, 30000, 5000, SPH_LIST_HALF);
        check_collapse(dim, 200000, 0, 0);
        check_collapse(dim, 200000, 100000, SPH_LIST_HALF);
    }
    check_collapse(3, 2000000, 0, 0);
}

/* Two crowds near each other that hashing has put into one bucket, though they are in different cells: each
   must be found once, in its own row. */
static void test_shared_buckets(void)
{
    enum { CROWD = 9, FAR = 2, SIDE = 6 };
    const sph_index n = 2 * CROWD + FAR;
    int dim, place, a;
    for (dim = 2; dim <= 3; dim++) {
        int found = 0;
        for (place = 0; place < SIDE * SIDE * (dim == 3 ? SIDE : 1) && found < 3; place++) {
            const int cell[3] = {place % SIDE, place / SIDE % SIDE, place / SIDE / SIDE};
            sample s = sample_new("two crowds", dim, n);
            sph_real *const coordinate[3] = {s.x, s.y, s.z};
            const size_t size = sph_grid_workspace(dim, n);
            void *const work = cloud_memory(size, 1);
            const sph_real one = SPH_R(1);
            int shared = 0;
            sph_grid g;
            sph_index i;
            size_t b;
            for (i = 0; i < n; i++) {
                s.R[i] = SPH_R(10); /* farther than both crowds, nearer than the other particles */
                for (a = 0; a < dim; a++) {
                    const double elsewhere = i < 2 * CROWD ? cell[a] + 0.5 : 1e5 * (double)i;
                    coordinate[a][i] = SPH_R(i < CROWD ? 0.0 : elsewhere);
                }
            }
            CHECK(sph_grid_build(dim, sample_points(&s), sph_scalars_same(&one), work, size, &g) == 0 && g.hashed);
            for (b = 0; b < g.buckets; b++) shared |= g.first[b + 1] - g.first[b] >= 2 * CROWD;
            shared &= cell[dim - 1] > 0; /* in another row */
            if (shared) check_rooms(&s, &g, SPH_GATHER, found ? SPH_LIST_HALF : 0);
            found += shared;
            free(work);
            sample_free(&s);
        }
        CHECK(found > 0);
    }
}

/* A crowd of the first particles, and the last one alone in a cell next to it: its row must hold all of the
   crowd. */
static void test_beside_a_crowd(void)
{
    enum { CROWD = 12 };
    int dim, k, a;
    for (dim = 1; dim <= 3; dim++)
        for (k = 1; k <= 8; k++) {
            sample s = sample_new("beside a crowd", dim, CROWD + 1);
            sph_real *const coordinate[3] = {s.x, s.y, s.z};
            const size_t size = sph_grid_workspace(dim, s.n);
            void *const work = cloud_memory(size, 1);
            sph_grid g;
            sample_radii(&s);
            for (a = 0; a < dim; a++) coordinate[a][CROWD] = SPH_R(0.17 * k);
            CHECK(sph_grid_build(dim, sample_points(&s), sph_scalars_array(s.R), work, size, &g) == 0);
            check_rooms(&s, &g, k % CRITERIA, 0);
            free(work);
            sample_free(&s);
        }
}

/* radii that a criterion does not use may be missing, also where cells are crowded */
static void test_unused_radii(void)
{
    const sph_scalars none = sph_scalars_array(0);
    pcg32 random;
    sample s;
    size_t size;
    void *work;
    sph_index *start;
    int64_t pairs[2] = {-1, -1};
    sph_grid g;
    sph_scalars R;
    pcg32_seed(&random, 16, 1);
    s = collapsed(2, 300, 0.0, 0.0, &random);
    s.x[7] = SPH_R(1e5); /* hashed cells: the loops for any radii */
    size = sph_grid_workspace(2, s.n);
    work = cloud_memory(size, 1);
    start = (sph_index *)cloud_memory((size_t)s.n + 1, sizeof *start);
    R = sph_scalars_array(s.R);
    CHECK(sph_grid_build(2, sample_points(&s), R, work, size, &g) == 0);
    CHECK(sph_grid_count(2, &g, sph_query_of(sample_points(&s), SPH_GATHER, R, 0), start, &pairs[0]) == 0);
    CHECK(sph_grid_count(2, &g, sph_query_of(sample_points(&s), SPH_SCATTER, none, 0), start, &pairs[1]) == 0);
    CHECK(pairs[0] > 0 && pairs[0] == pairs[1]); /* j gathers i where i scatters to j */
    free(work);
    free(start);
    sample_free(&s);
}

/* the smallest and the largest radius there may be */
static void test_radius_limits(void)
{
    const sph_real limits[2] = {SPHI_TINY, SPH_R(1) / SPHI_TINY};
    int k;
    for (k = 0; k < 2; k++) {
        const sph_real x[3] = {SPH_R(0), SPH_R(0.5) * limits[k], SPH_R(2) * limits[k]};
        const sph_scalars R = sph_scalars_same(&limits[k]);
        const size_t size = sph_grid_workspace(1, 3);
        void *const work = cloud_memory(size, 1);
        sph_index start[4];
        const sph_points points = sph_points_separate(3, x, 0, 0);
        int64_t pairs = -1;
        sph_grid g;
        CHECK(sph_grid_build(1, points, R, work, size, &g) == 0);
        CHECK(sph_grid_count(1, &g, sph_query_of(points, SPH_LARGER, R, 0), start, &pairs) == 0);
        CHECK(pairs == 2);
        free(work);
    }
}

int main(void)
{
    test_rooms();
    test_shared_buckets();
    test_beside_a_crowd();
    test_unused_radii();
    test_radius_limits();
    test_collapses();
    return check_report("test_capacity");
}
