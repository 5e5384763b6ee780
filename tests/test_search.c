/* SPDX-License-Identifier: MIT */
/*
 * test_search.c - the search in one call (sph_search), counting and filling told apart, and nothing as a
 * number: 0 particles, 0 targets. That lists are right is shown by test_neighbors.c; here sph_search must
 * give the same. What bad arguments get stands in CONTRACT.md.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 400, GUARD = 64, MARK = 0x5A };

/* ---------------------------------------------------------------- clouds of points, memory with guards */

typedef struct sample {
    int dim;
    sph_index n;
    sph_real x[MOST], y[MOST], z[MOST], radius[MOST];
} sample;

static sample sample_new(int dim, sph_index n, double radius, uint64_t seed)
{
    sample s;
    pcg32 random;
    sph_index i;
    memset(&s, 0, sizeof s);
    s.dim = dim;
    s.n = n;
    pcg32_seed(&random, seed, 1);
    for (i = 0; i < n; i++) {
        s.x[i] = SPH_R(pcg32_uniform(&random));
        s.y[i] = SPH_R(pcg32_uniform(&random));
        s.z[i] = SPH_R(pcg32_uniform(&random));
        s.radius[i] = SPH_R(radius * (0.25 + 0.75 * pcg32_uniform(&random)));
    }
    return s;
}
static sph_points points_of(const sample *s, int periodic)
{
    const sph_points x = sph_points_separate(s->n, s->x, s->dim > 1 ? s->y : 0, s->dim > 2 ? s->z : 0);
    return periodic ? sph_points_periodic(x, SPH_R(1), SPH_R(0), SPH_R(1)) : x;
}

/* `size` bytes that begin `shift` bytes behind an aligned address, with guards at both ends */
typedef struct block {
    unsigned char *base, *at;
    size_t size, shift;
} block;
static block block_new(size_t size, size_t shift)
{
    block b;
    b.base = (unsigned char *)cloud_memory(size + 2 * GUARD + shift, 1);
    memset(b.base, MARK, size + 2 * GUARD + shift);
    b.at = b.base + GUARD + shift;
    b.size = size;
    b.shift = shift;
    return b;
}
static int block_marked(const unsigned char *from, const unsigned char *to)
{
    while (from < to && *from == MARK) from++;
    return from == to;
}
static int block_intact(const block *b)
{
    return block_marked(b->base, b->at) && block_marked(b->at + b->size, b->at + b->size + GUARD);
}

/* ---------------------------------------------------------------- the same lists as in parts */

static void sort_row(sph_index *row, sph_index n)
{
    sph_index i, k;
    for (i = 1; i < n; i++) {
        const sph_index moved = row[i];
        for (k = i; k > 0 && row[k - 1] > moved; k--) row[k] = row[k - 1];
        row[k] = moved;
    }
}

/* The number of pairs; start and index as sph_grid_lists fills them, rows sorted. */
static int64_t lists_in_parts(int dim, sph_points x, sph_scalars radius, int criterion,
                              sph_index *start, sph_index **index)
{
    const size_t size = sph_grid_workspace(dim, x.n);
    void *const work = cloud_memory(size, 1);
    int64_t pairs = -1, filled = -1;
    sph_grid grid;
    if (sph_grid_build(dim, x, radius, work, size, &grid) != 0) abort();
    CHECK(sph_grid_count(dim, &grid, sph_query_of(x, criterion, radius, 0), start, &pairs) == 0);
    CHECK(start[x.n] == pairs);
    *index = (sph_index *)cloud_memory((size_t)pairs, sizeof **index);
    CHECK(sph_grid_lists(dim, &grid, sph_query_of(x, criterion, radius, SPH_LIST_SORTED), start, *index, pairs, &filled) == 0);
    CHECK(filled == pairs);
    free(work);
    return pairs;
}
static int same_lists(sph_index n, sph_list found, const sph_index *start, const sph_index *index)
{
    sph_index *const row = (sph_index *)cloud_memory((size_t)n, sizeof *row), i;
    int same = 1;
    for (i = 0; i < n && same; i++) {
        const sph_index length = found.start[i + 1] - found.start[i];
        same = found.start[i] == start[i] && length == start[i + 1] - start[i];
        if (!same || length == 0) continue;
        memcpy(row, found.index + found.start[i], (size_t)length * sizeof *row);
        sort_row(row, length);
        same = memcmp(row, index + start[i], (size_t)length * sizeof *row) == 0;
    }
    free(row);
    return same && found.start[n] == start[n];
}

/* a host's loop, from an empty block on */
static int calls_of(int dim, sph_points x, sph_scalars radius, int criterion, unsigned char **memory,
                    size_t *size, sph_neighbors *found)
{
    int calls = 0;
    sph_index answer;
    do {
        answer = sph_search(dim, x, radius, criterion, *memory, *size, found);
        if (calls++ > 8) abort();
        if (answer != SPH_ERROR_CAPACITY) continue;
        CHECK(!found->list.start && !found->list.index && found->grid.n == 0 && found->pairs >= 0);
        *size = sph_search_size(dim, x.n, found->pairs);
        *memory = (unsigned char *)realloc(*memory, *size);
        if (!*memory) abort();
        memset(*memory, MARK, *size);
    } while (answer == SPH_ERROR_CAPACITY);
    CHECK(answer == 0);
    return calls;
}

static void test_loop(void)
{
    static const double lengths[] = {0.01, 0.12, 0.45};
    static const sph_index counts[] = {1, 2, 17, MOST};
    int dim, criterion, way, k, c;
    for (dim = 1; dim <= 3; dim++)
        for (c = 0; c < 4; c++)
            for (k = 0; k < 3; k++) {
                sample s = sample_new(dim, counts[c], lengths[k], 7);
                const sph_real one = SPH_R(lengths[k]);
                const sph_index each = dim == 1 ? 8 : dim == 2 ? 32 : 128;
                unsigned char *memory = 0;
                size_t size = 0;
                sph_neighbors found;
                CHECK(sph_search(dim, points_of(&s, 0), sph_scalars_same(&one), SPH_GATHER, 0, 0, &found) ==
                      SPH_ERROR_CAPACITY);
                CHECK(found.pairs == (int64_t)s.n * (each < s.n - 1 ? each : s.n - 1));
                for (criterion = SPH_GATHER; criterion <= SPH_MEAN; criterion++)
                    for (way = 0; way < 4; way++) {
                        const sph_points x = points_of(&s, way & 1);
                        const sph_scalars radius =
                            way & 2 ? sph_scalars_array(s.radius) : sph_scalars_same(&one);
                        sph_index start[MOST + 1], *index;
                        const int64_t pairs = lists_in_parts(dim, x, radius, criterion, start, &index);
                        const int calls = calls_of(dim, x, radius, criterion, &memory, &size, &found);
                        CHECK(calls <= 3);
                        CHECK(found.pairs == pairs);
                        CHECK(same_lists(s.n, found.list, start, index));
                        CHECK(calls_of(dim, x, radius, criterion, &memory, &size, &found) ==
                              1); /* and again */
                        CHECK(same_lists(s.n, found.list, start, index));
                        free(index);
                    }
                free(memory);
            }
}

/* One radius that is far larger than the others: the grid is a tree. */
static void test_wide_radii(void)
{
    int dim, criterion, which;
    for (dim = 1; dim <= 3; dim++)
        for (which = 0; which < 3; which++)
            for (criterion = SPH_GATHER; criterion <= SPH_MEAN; criterion++) {
                sample s = sample_new(dim, MOST, 0.01, 11);
                unsigned char *memory = 0;
                size_t size = 0;
                sph_index start[MOST + 1], *index, i;
                sph_neighbors found;
                int64_t pairs;
                for (i = 0; i < MOST; i++)
                    s.radius[i] = which == 0 ? SPH_R(1e-6) : which == 1 ? SPH_R(0.3) / SPH_R(32) : SPH_R(0.3);
                s.radius[MOST / 2] = SPH_R(0.3);
                pairs = lists_in_parts(dim, points_of(&s, 0), sph_scalars_array(s.radius), criterion, start, &index);
                calls_of(dim, points_of(&s, 0), sph_scalars_array(s.radius), criterion, &memory, &size,
                         &found);
                CHECK(found.pairs == pairs && same_lists(MOST, found.list, start, index));
                free(index);
                free(memory);
            }
}

/* At every alignment of the block: enough is enough, less is not, and nothing outside is written. */
static void test_block(void)
{
    enum { FEW = 60 };
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        sample s = sample_new(dim, FEW, 0.3, 13);
        const sph_real one = SPH_R(0.3);
        const sph_points x = points_of(&s, 0);
        const sph_scalars radius = sph_scalars_same(&one);
        sph_index start[FEW + 1], *index;
        const int64_t pairs = lists_in_parts(dim, x, radius, SPH_GATHER, start, &index);
        const size_t needed = sph_search_size(dim, FEW, pairs), fixed = sph_search_size(dim, FEW, 0);
        size_t shift, k;
        CHECK(pairs > 0);
        CHECK(needed == fixed + (size_t)pairs * sizeof(sph_index) && fixed > sph_grid_workspace(dim, FEW));
        for (shift = 0; shift <= 16; shift++) {
            static const size_t spare[] = {0, 1, 3, 4, 7, 8, 1000};
            for (k = 0; k < sizeof spare / sizeof *spare; k++) {
                block b = block_new(needed + spare[k], shift);
                sph_neighbors found;
                CHECK(sph_search(dim, x, radius, SPH_GATHER, b.at, b.size, &found) == 0);
                CHECK(found.pairs == pairs && same_lists(FEW, found.list, start, index));
                CHECK((uintptr_t)found.list.start % sizeof(sph_index) == 0 &&
                      (uintptr_t)found.grid.x % sizeof(sph_real) == 0);
                CHECK((const unsigned char *)found.list.start >= b.at);
                CHECK((const unsigned char *)(found.list.index + pairs) <= b.at + b.size);
                CHECK(block_intact(&b));
                free(b.base);
            }
            for (k = 0; k < 60; k++) { /* at both ends of what the lists get, and in between */
                const size_t size = k < 20   ? needed - 1 - k
                                    : k < 40 ? fixed + 10 - k + 20
                                             : (k - 40) * needed / 20;
                block b = block_new(size, shift);
                sph_neighbors found;
                CHECK(sph_search(dim, x, radius, SPH_GATHER, b.at, b.size, &found) == SPH_ERROR_CAPACITY);
                CHECK(size < fixed ? block_marked(b.at, b.at + size) : found.pairs == pairs);
                CHECK(!found.list.start && block_intact(&b));
                free(b.base);
            }
            { /* a workspace of the grid alone */
                block b = block_new(sph_grid_workspace(dim, FEW), shift);
                sph_index again[FEW + 1];
                sph_grid grid;
                int64_t counted = -1;
                CHECK(sph_grid_build(dim, x, radius, b.at, b.size - 1, &grid) == SPH_ERROR_CAPACITY);
                CHECK(block_marked(b.at, b.at + b.size));
                CHECK(sph_grid_build(dim, x, radius, b.at, b.size, &grid) == 0);
                CHECK((uintptr_t)grid.x % sizeof *grid.x == 0 && (uintptr_t)grid.y % sizeof *grid.y == 0 &&
                      (uintptr_t)grid.z % sizeof *grid.z == 0);
                CHECK((uintptr_t)grid.member % sizeof(sph_index) == 0 &&
                      (uintptr_t)grid.first % sizeof(sph_index) == 0);
                CHECK(sph_grid_count(dim, &grid, sph_query_of(x, SPH_GATHER, radius, 0), again, &counted) == 0);
                CHECK(counted == pairs && memcmp(again, start, sizeof start) == 0 && block_intact(&b));
                free(b.base);
            }
        }
        free(index);
    }
}

/* What errors say and leave. */
static void test_errors(void)
{
    enum { FEW = 20 };
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        sample s = sample_new(dim, FEW, 0.3, 17);
        const sph_real one = SPH_R(0.3), bad = SPH_R(-1), wide = SPH_R(0.6);
        const sph_points x = points_of(&s, 0);
        block b = block_new(sph_search_size(dim, FEW, FEW * FEW), 3);
        sph_neighbors found;
        memset(&found, MARK, sizeof found);
#define REFUSED(call, error) \
    do { \
        found.pairs = -5; \
        found.list.start = s.n ? (const sph_index *)(const void *)&found : 0; \
        CHECK((call) == (error)); \
        CHECK(found.pairs == 0 && !found.list.start && !found.list.index && found.grid.n == 0); \
        CHECK(block_marked(b.base, b.at + b.size + GUARD)); \
    } while (0)
        REFUSED(sph_search(0, x, sph_scalars_same(&one), SPH_GATHER, b.at, b.size, &found), SPH_ERROR_DIM);
        REFUSED(sph_search(4, x, sph_scalars_same(&one), SPH_GATHER, b.at, b.size, &found), SPH_ERROR_DIM);
        REFUSED(sph_search(dim, x, sph_scalars_none(), SPH_GATHER, b.at, b.size, &found), SPH_ERROR_NULL);
        REFUSED(sph_search(dim, x, sph_scalars_same(&one), SPH_GATHER, 0, b.size, &found), SPH_ERROR_NULL);
        REFUSED(sph_search(dim, x, sph_scalars_same(&one), 4, b.at, b.size, &found), SPH_ERROR_VALUE);
        REFUSED(sph_search(dim, x, sph_scalars_same(&one), -1, b.at, b.size, &found), SPH_ERROR_VALUE);
        REFUSED(sph_search(dim, x, sph_scalars_same(&bad), SPH_GATHER, b.at, b.size, &found), SPH_ERROR_H);
        REFUSED(sph_search(dim, points_of(&s, 1), sph_scalars_same(&wide), SPH_GATHER, b.at, b.size, &found),
                SPH_ERROR_BOX);
        REFUSED(sph_search(dim, points_of(&s, 1), sph_scalars_same(&wide), SPH_GATHER, 0, 0, &found),
                SPH_ERROR_BOX);
        s.radius[FEW / 2] = SPH_R(0.6); /* one of them; the others would do */
        REFUSED(
            sph_search(dim, points_of(&s, 1), sph_scalars_array(s.radius), SPH_GATHER, b.at, b.size, &found),
            SPH_ERROR_BOX);
        CHECK(sph_search(dim, x, sph_scalars_same(&one), SPH_GATHER, b.at, b.size, 0) == SPH_ERROR_NULL);
        {
            sph_points other = x;
            other.n = -1;
            REFUSED(sph_search(dim, other, sph_scalars_same(&one), SPH_GATHER, b.at, b.size, &found),
                    SPH_ERROR_COUNT);
            other = x;
            other.stride = 0;
            REFUSED(sph_search(dim, other, sph_scalars_same(&one), SPH_GATHER, b.at, b.size, &found),
                    SPH_ERROR_COUNT);
            other = x;
            other.x = 0;
            REFUSED(sph_search(dim, other, sph_scalars_same(&one), SPH_GATHER, b.at, b.size, &found),
                    SPH_ERROR_NULL);
        }
        free(b.base);
    }
    for (dim = 1; dim <= 3; dim++) {
        const sph_index most = (sph_index)SPHI_INDEX_MAX;
        CHECK(sph_search_size(dim, -1, 0) == 0 && sph_search_size(dim, 1, -1) == 0 &&
              sph_search_size(dim, most, 0) == 0);
        CHECK(sph_search_size(dim, 1, INT64_MAX) == 0 &&
              sph_search_size(dim, 1, SPHI_INDEX_MAX + (sizeof most < 8)) == 0);
        CHECK(sph_search_size(dim, 0, 0) > 0 && sph_search_size(dim, 5, 9) > sph_search_size(dim, 5, 8));
        CHECK(sizeof(size_t) < 8 || sph_search_size(dim, 1000000, SPHI_INDEX_MAX) > (size_t)SPHI_INDEX_MAX);
    }
    CHECK(sph_search_size(0, 1, 1) == 0 && sph_search_size(4, 1, 1) == 0);
}

/* More pairs than can be counted: the loop ends, and not by memory. */
static void test_too_many(void)
{
    enum { MANY = 1 << 16 };
    const sph_real one = SPH_R(1);
    sph_real *const x = (sph_real *)cloud_memory(MANY, sizeof *x);
    const sph_points p = sph_points_separate(MANY, x, 0, 0);
    sph_neighbors found;
    size_t size;
    void *memory;
    sph_index i;
    for (i = 0; i < MANY; i++) x[i] = SPH_R(0.5);
    CHECK(sph_search(1, p, sph_scalars_same(&one), SPH_GATHER, 0, 0, &found) == SPH_ERROR_CAPACITY);
    size = sph_search_size(1, MANY, found.pairs);
    memory = cloud_memory(size, 1);
    CHECK(sph_search(1, p, sph_scalars_same(&one), SPH_GATHER, memory, size, &found) == SPH_ERROR_PAIRS);
    CHECK(found.pairs >= (int64_t)MANY * (MANY - 1) && !found.list.start);
    free(memory);
    free(x);
}

/* ---------------------------------------------------------------- counting and filling */

/* As with a vector that is empty at first, whose memory is null. */
static void test_empty_vector(void)
{
    int dim, criterion, way;
    for (dim = 1; dim <= 3; dim++)
        for (criterion = SPH_GATHER; criterion <= SPH_MEAN; criterion++)
            for (way = 0; way < 2; way++) {
                sample s = sample_new(dim, 100, way ? 0.3 : 1e-9, 19);
                const sph_points x = points_of(&s, 0);
                const sph_scalars radius = sph_scalars_array(s.radius);
                const size_t size = sph_grid_workspace(dim, s.n);
                void *const work = cloud_memory(size, 1);
                sph_index counted[MOST + 1], start[MOST + 1], *index = 0, answer;
                int64_t exact = -1, pairs = -1, room = 0;
                int calls = 0;
                sph_grid grid;
                CHECK(sph_grid_build(dim, x, radius, work, size, &grid) == 0);
                CHECK(sph_grid_count(dim, &grid, sph_query_of(x, criterion, radius, 0), counted, &exact) == 0);
                CHECK((exact > 0) == way);
                while ((answer = sph_grid_lists(dim, &grid, sph_query_of(x, criterion, radius, 0), start, index, room, &pairs)) == SPH_ERROR_CAPACITY) {
                    CHECK(pairs == exact && pairs > room);
                    room = pairs;
                    free(index);
                    index = (sph_index *)cloud_memory((size_t)room, sizeof *index);
                    if (calls++ > 3) abort();
                }
                CHECK(answer == 0 && pairs == exact && calls == way); /* no pair at all needs no index */
                CHECK(memcmp(start, counted, ((size_t)s.n + 1) * sizeof *start) == 0);
                pairs = -1; /* room, but no index */
                CHECK(sph_grid_lists(dim, &grid, sph_query_of(x, criterion, radius, 0), start, 0, 1, &pairs) ==
                      SPH_ERROR_NULL);
                CHECK(pairs == 0);
                pairs = -1;
                CHECK(sph_grid_lists(dim, &grid, sph_query_of(x, criterion, radius, 0), start, index, -1, &pairs) ==
                      SPH_ERROR_VALUE);
                CHECK(pairs == 0);
                pairs = -1;
                CHECK(sph_grid_count(dim, &grid, sph_query_of(x, 9, radius, 0), start, &pairs) == SPH_ERROR_VALUE &&
                      pairs == 0);
                pairs = -1;
                CHECK(sph_grid_count(dim, 0, sph_query_of(x, criterion, radius, 0), start, &pairs) ==
                          SPH_ERROR_NULL &&
                      pairs == 0);
                CHECK(sph_grid_count(dim, &grid, sph_query_of(x, criterion, radius, 0), start, 0) ==
                      SPH_ERROR_NULL);
                CHECK(sph_grid_lists(dim, &grid, sph_query_of(x, criterion, radius, 0), start, index, room, 0) ==
                      SPH_ERROR_NULL);
                free(index);
                free(work);
            }
}

/* ---------------------------------------------------------------- nothing */

static void test_nothing(void)
{
    int dim, criterion;
    for (dim = 1; dim <= 3; dim++)
        for (criterion = SPH_GATHER; criterion <= SPH_MEAN; criterion++) {
            const sph_points none = sph_points_separate(0, 0, 0, 0);
            const sph_scalars no = sph_scalars_none();
            sample s = sample_new(dim, 30, 0.3, 23);
            const sph_points x = points_of(&s, 0);
            const sph_scalars radius = sph_scalars_array(s.radius);
            const size_t size = sph_grid_workspace(dim, s.n);
            void *const work = cloud_memory(size, 1);
            sph_index start[MOST + 1], i;
            sph_neighbors found;
            sph_grid grid;
            int64_t pairs;
            int flags;
            /* no sources */
            memset(&grid, MARK, sizeof grid);
            CHECK(sph_grid_workspace(dim, 0) > 0);
            CHECK(sph_grid_build(dim, none, sph_scalars_none(), 0, 0, &grid) == 0);
            CHECK(sph_grid_permutation(&grid) == 0 && sph_grid_renumber(&grid) == 0);
            for (flags = 0; flags < 16; flags++) {
                if (flags & SPH_LIST_FOREIGN && flags & (SPH_LIST_SELF | SPH_LIST_HALF)) continue;
                for (i = 0; i < 3; i++) start[i] = -7;
                pairs = -1;
                CHECK(sph_grid_lists(dim, &grid, sph_query_of(none, criterion, no, flags), start, 0, 0, &pairs) == 0);
                CHECK(pairs == 0 && start[0] == 0 && start[1] == -7);
                start[0] = -7;
                pairs = -1;
                CHECK(sph_grid_count(dim, &grid, sph_query_of(none, criterion, no, flags), start, &pairs) == 0);
                CHECK(pairs == 0 && start[0] == 0 && start[1] == -7);
            }
            /* targets that look for sources where there are none */
            for (i = 0; i <= s.n + 1; i++) start[i] = -7;
            pairs = -1;
            CHECK(sph_grid_lists(dim, &grid, sph_query_of(x, criterion, no, SPH_LIST_FOREIGN), start, 0, 0, &pairs) ==
                      0 &&
                  pairs == 0);
            for (i = 0; i <= s.n; i++) CHECK(start[i] == 0);
            CHECK(start[s.n + 1] == -7);
            CHECK(sph_grid_lists(dim, &grid, sph_query_of(x, criterion, radius, 0), start, 0, 0, &pairs) ==
                  SPH_ERROR_RANGE);
            /* no targets among sources */
            CHECK(sph_grid_build(dim, x, radius, work, size, &grid) == 0);
            for (flags = 0; flags <= SPH_LIST_FOREIGN; flags += SPH_LIST_FOREIGN) {
                start[0] = start[1] = -7;
                pairs = -1;
                CHECK(sph_grid_lists(dim, &grid, sph_query_of(none, criterion, no, flags), start, 0, 0, &pairs) ==
                      0);
                CHECK(pairs == 0 && start[0] == 0 && start[1] == -7);
                start[0] = -7;
                CHECK(sph_grid_count(dim, &grid, sph_query_of(none, criterion, no, flags), start, &pairs) == 0);
                CHECK(pairs == 0 && start[0] == 0 && start[1] == -7);
            }
            /* the search in one call */
            memset(&found, MARK, sizeof found);
            CHECK(sph_search(dim, none, no, criterion, 0, 0, &found) == 0);
            CHECK(found.pairs == 0 && !found.list.start && !found.list.index && found.grid.n == 0 &&
                  found.grid.dim == dim);
            start[0] = -7;
            CHECK(sph_grid_count(dim, &found.grid, sph_query_of(x, criterion, radius, SPH_LIST_FOREIGN), start, &pairs) == 0);
            CHECK(start[0] == 0 && pairs == 0);
            /* the rest */
            CHECK(sph_permute(0, 0, 0, 1, 0) == 0 && sph_permute_inverse(0, 0, 0) == 0);
            CHECK(sph_permute(-1, 0, 0, 1, 0) == SPH_ERROR_COUNT &&
                  sph_permute_inverse(-1, 0, 0) == SPH_ERROR_COUNT);
            CHECK(sph_rebuild_due(dim, none, none, SPH_R(0.1)) == 0);
            CHECK(sph_rebuild_due(dim, none, x, SPH_R(0.1)) == SPH_ERROR_COUNT);
            CHECK(sph_rebuild_due(dim, x, none, SPH_R(0.1)) == SPH_ERROR_COUNT);
            {
                sph_points less = none;
                less.n = -1;
                CHECK(sph_grid_workspace(dim, -1) == 0);
                CHECK(sph_grid_build(dim, less, radius, work, size, &grid) == SPH_ERROR_COUNT);
                pairs = -1;
                CHECK(sph_grid_lists(dim, &grid, sph_query_of(less, criterion, no, 0), start, 0, 0, &pairs) ==
                          SPH_ERROR_COUNT &&
                      pairs == 0);
                CHECK(sph_rebuild_due(dim, less, less, SPH_R(1)) == SPH_ERROR_COUNT);
            }
            free(work);
        }
}

/* The grid that was found serves for more: an order, and other targets. */
static void test_grid_found(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        sample s = sample_new(dim, MOST, 0.2, 29), other = sample_new(dim, 50, 0.2, 31);
        const sph_real one = SPH_R(0.2);
        const sph_scalars radius = sph_scalars_same(&one);
        unsigned char seen[MOST], *memory = 0;
        sph_index start[MOST + 1], i, j;
        size_t size = 0;
        sph_neighbors found;
        int64_t pairs, brute = 0;
        calls_of(dim, points_of(&s, 0), radius, SPH_GATHER, &memory, &size, &found);
        memset(seen, 0, sizeof seen);
        for (i = 0; i < MOST; i++) seen[sph_grid_permutation(&found.grid)[i]]++;
        for (i = 0; i < MOST; i++) CHECK(seen[i] == 1);
        CHECK(sph_grid_count(dim, &found.grid, sph_query_of(points_of(&other, 0), SPH_GATHER, radius, SPH_LIST_FOREIGN), start, &pairs) == 0);
        for (i = 0; i < other.n; i++)
            for (j = 0; j < MOST; j++) {
                const double dx = (double)other.x[i] - (double)s.x[j];
                const double dy = dim > 1 ? (double)other.y[i] - (double)s.y[j] : 0.0;
                const double dz = dim > 2 ? (double)other.z[i] - (double)s.z[j] : 0.0;
                brute += dx * dx + dy * dy + dz * dz < 0.2 * 0.2;
            }
        CHECK(pairs == brute);
        free(memory);
    }
}

int main(void)
{
    test_loop();
    test_wide_radii();
    test_block();
    test_errors();
    test_too_many();
    test_empty_vector();
    test_nothing();
    test_grid_found();
    return check_report("test_search");
}
