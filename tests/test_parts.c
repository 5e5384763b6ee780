/* SPDX-License-Identifier: MIT */
/*
 * test_parts.c - one cloud as several machines would have it: parts of a periodic box, ranges of targets, which
 * particles a part needs of the others, rows without what nobody names and in the order of global numbers, and
 * own particles in the order of a grid with copies behind them. All in one process, by cutting a cloud by hand.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 1000, PARTS = 5 };

static double uniform(pcg32 *random) { return pcg32_uniform(random); }

/* lists of the targets first ... last - 1 of a query in new memory */
typedef struct rows {
    sph_index n, *start, *index;
    int64_t pairs;
} rows;
static rows rows_of(int dim, const sph_grid *grid, sph_query query)
{
    rows r;
    r.n = query.targets.n;
    r.start = (sph_index *)cloud_memory((size_t)r.n + 1, sizeof *r.start);
    CHECK(sph_grid_count(dim, grid, query, r.start, &r.pairs) == 0);
    r.index = (sph_index *)cloud_memory((size_t)r.pairs, sizeof *r.index);
    CHECK(sph_grid_lists(dim, grid, query, r.start, r.index, r.pairs, &r.pairs) == 0);
    return r;
}
static void rows_free(rows *r)
{
    free(r->start);
    free(r->index);
}
static void *grid_memory(int dim, sph_points x, sph_scalars radius, sph_grid *grid)
{
    const size_t size = sph_grid_workspace(dim, x.n);
    void *const work = cloud_memory(size, 1);
    CHECK(sph_grid_build(dim, x, radius, work, size, grid) == 0);
    return work;
}

/* ---------------------------------------------------------------- a part of a periodic box */

/* A corner of a box that is `parts` times as long each way: as it stands, and moved into the box, where it is
   cut in pieces. The same pairs as in an open domain; and the grid has no more cells than the part needs. */
static void test_part_of_box(int dim, int parts)
{
    static const int side[] = {0, 500, 25, 9};
    const sph_real radius = SPH_R(2.1);
    const double length = (double)side[dim] * parts;
    const sph_scalars reach = sph_scalars_same(&radius);
    cloud c = cloud_lattice(dim, side[dim], 1.3, 0.3, 3);
    sph_real *const x[3] = {c.x, c.y, c.z};
    sph_query query;
    sph_grid grid;
    rows open;
    void *work;
    int way, a;
    sph_index i;
    for (a = 0; a < dim; a++)
        for (i = 0; i < c.n; i++) x[a][i] = SPH_R(floor(((double)x[a][i] - 0.5) * (side[dim] - 1) * 32.0) / 32.0); /* exact wherever it is moved */
    query = sph_query_of(sph_points_separate(c.n, c.x, c.y, c.z), SPH_GATHER, reach, SPH_LIST_SORTED);
    work = grid_memory(dim, query.targets, reach, &grid);
    open = rows_of(dim, &grid, query);
    free(work);
    for (way = 0; way < 3; way++) { /* around 0; in the box; somewhere else, each in an image of its own */
        rows boxed;
        for (a = 0; a < dim; a++)
            for (i = 0; i < c.n; i++) {
                if (way == 1 && x[a][i] < SPH_R(0)) x[a][i] += SPH_R(length);
                if (way == 2) x[a][i] += SPH_R(length) * SPH_R((i * 7) % 3 - 1);
            }
        query.targets = sph_points_periodic(query.targets, SPH_R(length), SPH_R(length), SPH_R(length));
        work = grid_memory(dim, query.targets, reach, &grid);
        boxed = rows_of(dim, &grid, query);
        CHECK(!grid.hashed && grid.buckets <= 2 * (size_t)c.n);
        CHECK(boxed.pairs == open.pairs);
        if (boxed.pairs == open.pairs) {
            CHECK(!memcmp(boxed.start, open.start, ((size_t)c.n + 1) * sizeof *open.start));
            CHECK(!memcmp(boxed.index, open.index, (size_t)open.pairs * sizeof *open.index));
        }
        rows_free(&boxed);
        free(work);
    }
    rows_free(&open);
    cloud_free(&c);
}

/* ---------------------------------------------------------------- a cloud with radii that differ */

typedef struct cluster {
    sph_index n;
    sph_real x[MOST], y[MOST], z[MOST], radius[MOST], h[MOST], m[MOST], rho[MOST];
    int64_t id[MOST];
} cluster;

/* dense in the middle, with radii that differ by more than ten; periodic: the middle is in the corners */
static void cluster_fill(cluster *c, int periodic)
{
    pcg32 random;
    sph_index i;
    pcg32_seed(&random, 17, 4);
    c->n = MOST;
    for (i = 0; i < MOST; i++) {
        const double u = uniform(&random), r = 0.5 * pow(u, 1.5), z = 2.0 * uniform(&random) - 1.0, phi = 2.0 * PI * uniform(&random);
        const double s = sqrt(1.0 - z * z), at[3] = {0.5 + r * s * cos(phi), 0.5 + r * s * sin(phi), 0.5 + r * z};
        sph_real *const x[3] = {c->x, c->y, c->z};
        int a;
        for (a = 0; a < 3; a++) x[a][i] = SPH_R(periodic ? (at[a] >= 0.5 ? at[a] - 0.5 : at[a] + 0.5) : at[a]);
        c->radius[i] = SPH_R(fmin(0.4, 0.06 + 0.5 * r));
        c->h[i] = c->radius[i] / sph_kernel_support_ratio(SPH_WENDLAND_C2);
        c->m[i] = SPH_R(1.0 + uniform(&random));
        c->id[i] = ((int64_t)1 << 40) - 977 * (int64_t)i; /* in another order than the particles */
    }
}
static sph_points cluster_points(const cluster *c, int dim, int periodic)
{
    const sph_points p = sph_points_separate(c->n, c->x, dim > 1 ? c->y : 0, dim > 2 ? c->z : 0);
    return periodic ? sph_points_periodic(p, SPH_R(1), SPH_R(1), SPH_R(1)) : p;
}
static void cluster_copy(cluster *to, const cluster *from, sph_index i)
{
    const sph_index k = to->n++;
    to->x[k] = from->x[i];
    to->y[k] = from->y[i];
    to->z[k] = from->z[i];
    to->radius[k] = from->radius[i];
    to->h[k] = from->h[i];
    to->m[k] = from->m[i];
    to->id[k] = from->id[i];
}

/* which part a particle belongs to: slices of another axis for each dim, and none in the last one but one */
static int part_of(const cluster *c, int dim, sph_index i)
{
    const sph_real at = dim == 1 ? c->x[i] : dim == 2 ? c->y[i] : c->z[i];
    const int k = (int)(at * SPH_R(PARTS - 1));
    return k < 0 ? 0 : k >= PARTS - 2 ? PARTS - 1 : k;
}
static uint64_t mixed(uint64_t a)
{
    a = (a ^ a >> 30) * 0xbf58476d1ce4e5b9u;
    return a ^ a >> 31;
}
static uint64_t hash_of(const rows *r, const int64_t *id)
{
    uint64_t sum = 0;
    sph_index i, p;
    for (i = 0; i < r->n; i++)
        for (p = r->start[i]; p < r->start[i + 1]; p++) sum += mixed((uint64_t)id[i] * 0x9e3779b97f4a7c15u + (uint64_t)id[r->index[p]]);
    return sum;
}
/* densities with sorted rows */
static void densities(int dim, cluster *c, sph_index targets, rows *r, int periodic)
{
    sph_list list;
    sph_cloud whole;
    list.start = r->start;
    list.index = r->index;
    whole = sph_cloud_of(cluster_points(c, dim, periodic), list, sph_scalars_array(c->h), sph_scalars_none());
    CHECK(sph_list_sort(targets, c->n, r->start, r->index, c->id) == 0);
    CHECK(sph_density_summation(SPH_WENDLAND_C2, dim, sph_cloud_range(whole, 0, targets), sph_scalars_array(c->m), (sph_scalar_out){.p = c->rho}) >= 0);
}

/* The cloud whole, and in parts with copies of what sph_select_near names: the same pairs, the same bits. */
static void test_cut(int dim, int periodic, int criterion)
{
    static cluster all, own[PARTS], part;
    sph_part where[PARTS];
    sph_query query;
    sph_grid grid;
    rows whole;
    uint64_t sum = 0;
    int64_t pairs = 0, copies = 0, named = 0;
    void *work;
    int k, other;
    sph_index i;
    cluster_fill(&all, periodic);
    query = sph_query_of(cluster_points(&all, dim, periodic), criterion, sph_scalars_array(all.radius), 0);
    work = grid_memory(dim, query.targets, query.radius, &grid);
    whole = rows_of(dim, &grid, query);
    free(work);
    densities(dim, &all, all.n, &whole, periodic);
    for (k = 0; k < PARTS; k++) own[k].n = 0;
    for (i = 0; i < all.n; i++) {
        cluster *const to = &own[part_of(&all, dim, i)];
        to->rho[to->n] = all.rho[i];
        cluster_copy(to, &all, i);
    }
    for (k = 0; k < PARTS; k++) CHECK(sph_part_of(dim, cluster_points(&own[k], dim, periodic), sph_scalars_array(own[k].radius), &where[k]) == 0);
    for (k = 0; k < PARTS; k++) {
        static sph_index chosen[MOST], kept[MOST];
        const sph_index n = own[k].n;
        int64_t count;
        rows mine;
        part = own[k];
        for (other = 0; other < PARTS; other++) {
            if (other == k) continue;
            CHECK(sph_select_near(dim, cluster_points(&own[other], dim, periodic), sph_scalars_array(own[other].radius), criterion, where[k], chosen, &count) == 0);
            for (i = 0; i < count; i++) cluster_copy(&part, &own[other], chosen[i]);
        }
        copies += part.n - n;
        CHECK(n > 0 || part.n == 0); /* nobody needs anything for nothing */
        query = sph_query_of(cluster_points(&part, dim, periodic), criterion, sph_scalars_array(part.radius), 0);
        work = grid_memory(dim, query.targets, query.radius, &grid);
        query.targets.n = n;
        mine = rows_of(dim, &grid, query);
        free(work);
        pairs += mine.pairs;
        sum += hash_of(&mine, part.id);
        CHECK(sph_list_prune(n, part.n, mine.start, mine.index, kept, &count) == 0);
        for (i = 0; i < count; i++) {
            CHECK(kept[i] >= i && (i < n ? kept[i] == i : kept[i] > kept[i - 1]));
            part.x[i] = part.x[kept[i]];
            part.y[i] = part.y[kept[i]];
            part.z[i] = part.z[kept[i]];
            part.radius[i] = part.radius[kept[i]];
            part.h[i] = part.h[kept[i]];
            part.m[i] = part.m[kept[i]];
            part.id[i] = part.id[kept[i]];
        }
        part.n = (sph_index)count;
        named += count - n;
        densities(dim, &part, n, &mine, periodic);
        for (i = 0; i < n; i++) CHECK(part.rho[i] == own[k].rho[i]); /* the same bits */
        rows_free(&mine);
    }
    CHECK(pairs == whole.pairs);
    CHECK(sum == hash_of(&whole, all.id));
    CHECK(named > 0 && named <= copies);
    rows_free(&whole);
}
/* A part that is told too little misses pairs: without the radii of the sources, by SPH_LARGER. */
static void test_too_little(void)
{
    static cluster all;
    static sph_index chosen[MOST];
    sph_part part;
    int64_t gather, larger;
    sph_points x;
    cluster_fill(&all, 0);
    x = cluster_points(&all, 3, 0);
    all.n = 100;
    CHECK(sph_part_of(3, cluster_points(&all, 3, 0), sph_scalars_array(all.radius), &part) == 0);
    CHECK(sph_select_near(3, x, sph_scalars_array(all.radius), SPH_GATHER, part, chosen, &gather) == 0);
    CHECK(sph_select_near(3, x, sph_scalars_array(all.radius), SPH_LARGER, part, chosen, &larger) == 0);
    CHECK(gather <= larger);
    /* an empty part needs nothing, and is told as such */
    x.n = 0;
    CHECK(sph_part_of(3, x, sph_scalars_none(), &part) == 0);
    CHECK(part.low.x > part.high.x && part.reach_low.z > part.reach_high.z);
    CHECK(sph_select_near(3, cluster_points(&all, 3, 0), sph_scalars_array(all.radius), SPH_LARGER, part, chosen, &larger) == 0);
    CHECK(larger == 0);
    /* by hand: one target at 0 with the radius 1, sources on a line */
    {
        static sph_real line[] = {SPH_R(-2.5), SPH_R(-1.5), SPH_R(-1), SPH_R(0.5), SPH_R(1.5), SPH_R(3)};
        const sph_real one = SPH_R(1), wide = SPH_R(1.6), zero = SPH_R(0);
        const sph_points target = sph_points_separate(1, (sph_real[]){SPH_R(0)}, 0, 0);
        sph_points sources = sph_points_separate(6, line, 0, 0);
        CHECK(sph_part_of(1, target, sph_scalars_same(&one), &part) == 0);
        CHECK(part.low.x == zero && part.high.x == zero && part.reach_low.x == -one && part.reach_high.x == one);
        CHECK(sph_select_near(1, sources, sph_scalars_none(), SPH_GATHER, part, chosen, &gather) == 0);
        CHECK(gather == 2 && chosen[0] == 2 && chosen[1] == 3);
        CHECK(sph_select_near(1, sources, sph_scalars_same(&wide), SPH_SCATTER, part, chosen, &gather) == 0);
        CHECK(gather == 4 && chosen[0] == 1 && chosen[3] == 4);
        sources = sph_points_periodic(sources, SPH_R(3.5), SPH_R(0), SPH_R(0)); /* -2.5 is 1, 3 is -0.5 */
        CHECK(sph_select_near(1, sources, sph_scalars_none(), SPH_GATHER, part, chosen, &gather) == 0);
        CHECK(gather == 4 && chosen[0] == 0 && chosen[1] == 2 && chosen[2] == 3 && chosen[3] == 5);
    }
}

/* ---------------------------------------------------------------- ranges of targets */

/* What ranges find, one after the other, is what the whole finds: any criterion, flags and order. */
static void test_ranges(int dim, int scattered)
{
    static cluster c, mixed_up;
    static const int flags[] = {0, SPH_LIST_SELF, SPH_LIST_HALF | SPH_LIST_SORTED, SPH_LIST_FOREIGN};
    sph_index order[MOST], i;
    sph_query query;
    sph_grid grid;
    void *work;
    int criterion, f, k;
    cluster_fill(&c, 0);
    work = grid_memory(dim, cluster_points(&c, dim, 0), sph_scalars_array(c.radius), &grid);
    for (i = 0; i < c.n; i++) order[i] = scattered ? (sph_index)(i * 371 % MOST) : sph_grid_permutation(&grid)[i];
    mixed_up.n = 0;
    for (i = 0; i < c.n; i++) cluster_copy(&mixed_up, &c, order[i]);
    free(work);
    work = grid_memory(dim, cluster_points(&mixed_up, dim, 0), sph_scalars_array(mixed_up.radius), &grid);
    for (criterion = SPH_GATHER; criterion <= SPH_MEAN; criterion++)
        for (f = 0; f < 4; f++) {
            static const sph_index cut[] = {0, 0, 40, 41, 700, MOST};
            rows whole;
            query = sph_query_of(cluster_points(&mixed_up, dim, 0), criterion, sph_scalars_array(mixed_up.radius), flags[f]);
            whole = rows_of(dim, &grid, query);
            for (k = 0; k < 5; k++) {
                rows some = rows_of(dim, &grid, sph_query_range(query, cut[k], cut[k + 1]));
                CHECK(some.start[0] == 0 && some.n == cut[k + 1] - cut[k]);
                for (i = 0; i < some.n; i++) CHECK(some.start[i + 1] == whole.start[cut[k] + i + 1] - whole.start[cut[k]]);
                /* the order within a row may be another one */
                CHECK(sph_list_sort(some.n, MOST, some.start, some.index, 0) == 0);
                if (k == 0) CHECK(sph_list_sort(MOST, MOST, whole.start, whole.index, 0) == 0);
                CHECK(!memcmp(some.index, whole.index + whole.start[cut[k]], (size_t)some.pairs * sizeof *some.index));
                rows_free(&some);
            }
            rows_free(&whole);
        }
    /* a range of a range; and none that there is not */
    query = sph_query_of(cluster_points(&mixed_up, dim, 0), SPH_GATHER, sph_scalars_array(mixed_up.radius), 0);
    CHECK(sph_query_range(sph_query_range(query, 100, 200), 30, 40).first == 130);
    {
        sph_index start[MOST + 1];
        int64_t pairs;
        CHECK(sph_grid_count(dim, &grid, sph_query_range(query, 5, 4), start, &pairs) == SPH_ERROR_COUNT);
        CHECK(sph_grid_count(dim, &grid, sph_query_range(query, 0, MOST + 1), start, &pairs) == SPH_ERROR_COUNT);
        query.first = 1; /* and then the last target is no source */
        CHECK(sph_grid_count(dim, &grid, query, start, &pairs) == SPH_ERROR_RANGE);
        query.first = -1;
        CHECK(sph_grid_count(dim, &grid, query, start, &pairs) == SPH_ERROR_RANGE);
    }
    free(work);
}

/* ---------------------------------------------------------------- own particles in the order of the grid */

static void test_own_order(int dim)
{
    static cluster c, sorted;
    static sph_index order[MOST], rank[MOST];
    const sph_index own = 600;
    sph_query query;
    sph_grid grid, again;
    rows before, after;
    void *work, *work_again;
    sph_index i, ascents = 0;
    cluster_fill(&c, 0);
    work = grid_memory(dim, cluster_points(&c, dim, 0), sph_scalars_array(c.radius), &grid);
    CHECK(sph_grid_permutation_own(&grid, own, order) == 0);
    CHECK(sph_permute_inverse(MOST, order, rank) == 0);
    for (i = own; i < MOST; i++) CHECK(order[i] == i);
    for (i = 0; i < own; i++) CHECK(order[i] < own && order[rank[i]] == i);
    sorted.n = 0;
    for (i = 0; i < MOST; i++) cluster_copy(&sorted, &c, order[i]);
    CHECK(sph_grid_renumber_own(&grid, own) == 0);
    query = sph_query_of(cluster_points(&sorted, dim, 0), SPH_LARGER, sph_scalars_array(sorted.radius), SPH_LIST_SORTED);
    before = rows_of(dim, &grid, query);
    work_again = grid_memory(dim, query.targets, query.radius, &again);
    after = rows_of(dim, &again, query);
    CHECK(before.pairs == after.pairs && !memcmp(before.index, after.index, (size_t)after.pairs * sizeof *after.index));
    /* and own ones follow each other in the grid */
    for (i = 1; i < MOST; i++) ascents += grid.member[i] < own && grid.member[i - 1] < own && grid.member[i] == grid.member[i - 1] + 1;
    CHECK(ascents > 0);
    CHECK(sph_grid_permutation_own(&grid, MOST + 1, order) == SPH_ERROR_COUNT);
    CHECK(sph_grid_renumber_own(&grid, -1) == SPH_ERROR_COUNT);
    rows_free(&before);
    rows_free(&after);
    free(work);
    free(work_again);
}

int main(void)
{
    int dim, periodic, criterion, parts;
    for (dim = 1; dim <= 3; dim++) {
        for (parts = 2; parts <= 512; parts *= 4) test_part_of_box(dim, parts);
        for (periodic = 0; periodic < 2; periodic++)
            for (criterion = SPH_GATHER; criterion <= SPH_MEAN; criterion++) test_cut(dim, periodic, criterion);
        test_ranges(dim, 0);
        test_ranges(dim, 1);
        test_own_order(dim);
    }
    test_too_little();
    return check_report("test_parts");
}
