/* SPDX-License-Identifier: MIT */
/*
 * neighbors.c - fuzz target: the search of sph.h against all pairs, in memory of just the size that is
 * asked for, so that the sanitizer sees what is read or written beyond. All criteria and flags, periodic
 * boxes, other targets than sources, room for too few, just enough or more than enough pairs, coordinates
 * that are no numbers or near the end of the range. A pair whose distance is within 8 ulp of the radius (in
 * a box, of the largest of radius, box length and coordinates) may be in or out; all others must be as they
 * are. Whatever the room and, with -fopenmp -DSPH_OPENMP=1, the number of threads, the lists are the same.
 * -DSPHI_CROWDED=4 makes cells of so few particles crowded ones, -DSPHI_LEAF=1 a tree that is as deep as can be.
 */
#include "fuzz.h"

#include "../../sph.h"

enum { MOST = 100 }; /* more than a tile of the search */

typedef struct problem {
    int dim, criterion, flags;
    sph_points sources, targets;
    sph_scalars source_radius, target_radius;
} problem;

static long double larger(long double a, long double b) { return a > b ? a : b; }

static long double pair_distance(const problem *p, sph_index i, sph_index j, long double *scale)
{
    const sph_real *const x[3] = {p->targets.x, p->targets.y, p->targets.z}, *const y[3] = {p->sources.x, p->sources.y, p->sources.z};
    const sph_real box[3] = {p->sources.box.x, p->sources.box.y, p->sources.box.z};
    long double sum = 0.0L;
    int c;
    *scale = 0.0L;
    for (c = 0; c < p->dim; c++) {
        const long double a = (long double)x[c][(size_t)i * p->targets.stride], b = (long double)y[c][(size_t)j * p->sources.stride], length = (long double)box[c];
        const long double d = length > 0.0L ? remainderl(a - b, length) : a - b;
        sum += d * d;
        if (length > 0.0L) *scale = larger(*scale, larger(length, larger(fabsl(a), fabsl(b))));
    }
    return sqrtl(sum);
}

static long double ulp(long double x)
{
    int e;
    (void)frexpl(x, &e);
    return ldexpl((long double)SPH_EPSILON, e - 1);
}

/* 1: must be in the row, 0: must not, 2: either */
static int belongs(const problem *p, sph_index i, sph_index j)
{
    const long double R_i = p->criterion == SPH_SCATTER ? 0.0L : (long double)p->target_radius.p[(size_t)i * p->target_radius.stride];
    const long double R_j = p->criterion == SPH_GATHER ? 0.0L : (long double)p->source_radius.p[(size_t)j * p->source_radius.stride];
    const long double R = p->criterion == SPH_GATHER ? R_i : p->criterion == SPH_SCATTER ? R_j : p->criterion == SPH_LARGER ? larger(R_i, R_j) : 0.5L * (R_i + R_j);
    long double r, scale;
    if (!(p->flags & SPH_LIST_FOREIGN) && ((i == j && !(p->flags & SPH_LIST_SELF)) || (j < i && (p->flags & SPH_LIST_HALF)))) return 0;
    r = pair_distance(p, i, j, &scale);
    if (fabsl(r - R) <= 8 * ulp(larger(R, scale))) return 2;
    return r < R;
}

static void check_rows(const problem *p, const sph_index *start, const sph_index *index, int64_t pairs)
{
    unsigned char seen[MOST];
    sph_index i, j, q;
    FUZZ_REQUIRE(start[0] == 0 && start[p->targets.n] == pairs);
    for (i = 0; i < p->targets.n; i++) {
        memset(seen, 0, sizeof seen);
        FUZZ_REQUIRE(start[i + 1] >= start[i]);
        for (q = start[i]; q < start[i + 1]; q++) {
            FUZZ_REQUIRE(index[q] >= 0 && index[q] < p->sources.n);
            FUZZ_REQUIRE(!seen[index[q]]);
            seen[index[q]] = 1;
            if ((p->flags & SPH_LIST_SORTED) && q > start[i]) FUZZ_REQUIRE(index[q] > index[q - 1]);
        }
        for (j = 0; j < p->sources.n; j++) {
            const int want = belongs(p, i, j);
            if (want < 2) FUZZ_REQUIRE(seen[j] == want);
        }
    }
}

#if SPH_OPENMP /* what clang's library keeps to the end is no leak */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libomp"; }
#endif

static void threads(int count)
{
#if SPH_OPENMP
    omp_set_num_threads(count);
#else
    (void)count;
#endif
}

static sph_index lists(const problem *p, const sph_grid *g, sph_index *start, sph_index *index, int64_t room,
                       int64_t *pairs)
{
    return sph_grid_lists(p->dim, g, sph_query_of(p->targets, p->criterion, p->target_radius, p->flags), start, index, room, pairs);
}

/* with just this room and so many threads */
static void check_room(const problem *p, const sph_grid *g, int count, int64_t room, const sph_index *start,
                       const sph_index *index, int64_t pairs)
{
    const size_t n = (size_t)p->targets.n;
    sph_index *const s = (sph_index *)fuzz_memory(n + 1, sizeof *s);
    sph_index *const q = (sph_index *)fuzz_memory((size_t)room, sizeof *q);
    int64_t found = -1;
    sph_index answer;
    threads(count);
    answer = lists(p, g, s, q, room, &found);
    FUZZ_REQUIRE(found == pairs && answer == (pairs > room ? SPH_ERROR_CAPACITY : 0));
    FUZZ_REQUIRE(answer != 0 || memcmp(s, start, (n + 1) * sizeof *s) == 0);
    FUZZ_REQUIRE(answer != 0 || memcmp(q, index, (size_t)pairs * sizeof *q) == 0);
    free(s);
    free(q);
}

/* few: room for so many; share: room for 128 + so many 256ths of the pairs */
static void check_lists(const problem *p, const sph_grid *g, int count, int64_t few, int64_t share)
{
    const size_t n = p->targets.n > 0 ? (size_t)p->targets.n : 0;
    sph_index *const start = (sph_index *)fuzz_memory(n + 1, sizeof *start), *index;
    int64_t pairs = -1, again = -1;
    sph_index answer;
    threads(1);
    answer = sph_grid_count(p->dim, g, sph_query_of(p->targets, p->criterion, p->target_radius, p->flags), start, &pairs);
    if (answer < 0) FUZZ_REQUIRE(pairs == 0);
    else {
        FUZZ_REQUIRE(answer == 0 && pairs >= 0 && pairs <= (int64_t)p->targets.n * p->sources.n);
        index = (sph_index *)fuzz_memory((size_t)pairs, sizeof *index);
        FUZZ_REQUIRE(lists(p, g, start, index, pairs, &again) == 0 && again == pairs);
        check_rows(p, start, index, pairs);
        check_room(p, g, count, few, start, index, pairs);
        check_room(p, g, count, pairs * (128 + share) / 256, start, index, pairs);
        check_room(p, g, count, pairs > 0 ? pairs - 1 : 0, start, index, pairs);
        check_room(p, g, count, pairs, start, index, pairs);
        check_room(p, g, count, pairs + 65536, start, index, pairs); /* far apart: threads close the gaps */
        free(index);
    }
    free(start);
}

/* the order is a permutation, and permuting by it and renumbering gives the same lists of the same particles */
static void check_order(const problem *p, sph_grid *g)
{
    const sph_index *const order = sph_grid_permutation(g);
    sph_real *const sorted = (sph_real *)fuzz_memory((size_t)p->sources.n, sizeof *sorted), *const plain = (sph_real *)fuzz_memory((size_t)p->sources.n, sizeof *plain);
    sph_index *const inverse = (sph_index *)fuzz_memory((size_t)p->sources.n, sizeof *inverse);
    sph_index s;
    for (s = 0; s < p->sources.n; s++) plain[s] = p->sources.x[(size_t)s * p->sources.stride];
    FUZZ_REQUIRE(sph_permute_inverse(p->sources.n, order, inverse) == 0);
    FUZZ_REQUIRE(sph_permute(p->sources.n, order, plain, 1, sorted) == 0);
    for (s = 0; s < p->sources.n; s++) FUZZ_REQUIRE(order[inverse[s]] == s && inverse[order[s]] == s && memcmp(&sorted[inverse[s]], &plain[s], sizeof *sorted) == 0);
    FUZZ_REQUIRE(sph_grid_renumber(g) == 0);
    for (s = 0; s < p->sources.n; s++) FUZZ_REQUIRE(sph_grid_permutation(g)[s] == s);
    free(sorted);
    free(plain);
    free(inverse);
}

/* coordinates with a stride, each array of just its size */
typedef struct cloud {
    sph_real *x[3];
} cloud;
/* Particles that follow each other are of one block: a lattice of any spacing, 0 as well, where all are in
   one place. The rows of one block are longer than those of another, so that the share of one thread is
   used up before the room is. */
static void cloud_blocks(cloud *c, fuzz_input *in, int dim, sph_index n, size_t stride, double scale)
{
    sph_index i = 0, q;
    int a;
    while (i < n) {
        const int most = 1 + fuzz_below(in, MOST), side = 1 + fuzz_below(in, 6);
        const double spacing = fuzz_below(in, 9) / 32.0;
        double corner[3];
        for (a = 0; a < dim; a++) corner[a] = fuzz_tame(in);
        for (q = 0; q < most && i < n; q++, i++) {
            const int cell[3] = {q % side, q / side % side, q / side / side};
            for (a = 0; a < dim; a++)
                c->x[a][(size_t)i * stride] = SPH_R(scale * (corner[a] + spacing * cell[a]));
        }
    }
}
static sph_points cloud_new(cloud *c, fuzz_input *in, int dim, sph_index n, int tame, int blocks,
                            double scale)
{
    const size_t stride = (size_t)(1 + fuzz_below(in, 3));
    const size_t count = n > 0 ? ((size_t)n - 1) * stride + 1 : 0;
    sph_index i;
    int a;
    for (a = 0; a < 3; a++) {
        c->x[a] = (sph_real *)fuzz_memory(a < dim ? count : 0, sizeof(sph_real));
        for (i = 0; !blocks && a < dim && i < n; i++)
            c->x[a][(size_t)i * stride] = SPH_R(scale * (tame ? fuzz_tame(in) : fuzz_number(in)));
    }
    if (blocks) cloud_blocks(c, in, dim, n, stride, scale);
    return sph_points_strided(n, c->x[0], c->x[1], c->x[2], stride);
}
static void cloud_free(cloud *c)
{
    int a;
    for (a = 0; a < 3; a++) free(c->x[a]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    const int how = (int)fuzz_byte(&in), tame = (how & 3) != 0, periodic = (how >> 2) & 7, each = (how >> 5) & 3, foreign = how >> 7;
    const double scale = (how & 3) == 3 ? fuzz_scale(&in, SPH_SINGLE ? 10 : 100) : 1.0;
    const sph_index n = (sph_index)fuzz_below(&in, MOST + 1), m = (sph_index)fuzz_below(&in, MOST + 1);
    const int64_t few = fuzz_below(&in, 64);
    const int shape = (int)fuzz_byte(&in), blocks = shape & 1, count = 1 + (shape >> 1) % 8;
    const int64_t share = (int64_t)fuzz_byte(&in);
    sph_real *const R = (sph_real *)fuzz_memory(2 * MOST, sizeof *R), *const S = R + MOST, box[3] = {SPH_R(0), SPH_R(0), SPH_R(0)}, reach, skin;
    size_t bytes;
    void *work;
    cloud a, b;
    problem p;
    sph_grid g;
    sph_index i;
    int c, answer;
    p.dim = 1 + fuzz_below(&in, 3);
    p.criterion = fuzz_below(&in, 5);
    p.flags = (int)fuzz_byte(&in) & (tame ? 7 : 31);
    if (foreign) p.flags = (p.flags & ~3) | SPH_LIST_FOREIGN;
    reach = SPH_R(scale * (tame ? 0.02 + fuzz_unit(&in) : fuzz_number(&in)));
    for (c = 0; c < 3; c++)
        if (periodic >> c & 1) box[c] = SPH_R(scale * (tame ? 0.5 + 3 * fuzz_unit(&in) : fuzz_number(&in)));
    for (i = 0; i < 2 * MOST; i++) R[i] = SPH_R((each > 1 ? 0.03 + 4 * fuzz_unit(&in) : 1) * (double)reach);
    p.sources = cloud_new(&a, &in, p.dim, n, tame, blocks, scale);
    p.sources = sph_points_periodic(p.sources, box[0], box[1], box[2]);
    p.targets = p.sources;
    if (foreign) p.targets = cloud_new(&b, &in, p.dim, m, tame, blocks, scale);
    else if (m < n) p.targets.n = m; /* the first of them */
    p.target_radius = each ? sph_scalars_array(R) : sph_scalars_same(R);
    p.source_radius = each ? sph_scalars_array(S) : sph_scalars_same(&reach); /* reach is R, too */
    if (p.criterion == SPH_SCATTER) p.target_radius = sph_scalars_array(0);

    bytes = sph_grid_workspace(p.dim, n);
    FUZZ_REQUIRE(bytes > 0);
    work = fuzz_memory(bytes, 1);
    threads(1);
    answer = (int)sph_grid_build(p.dim, p.sources, p.source_radius, work, bytes, &g);
    FUZZ_REQUIRE(answer <= 0 && answer >= SPH_ERROR_BOX);
    if (answer == 0) {
        void *const other = fuzz_memory(bytes, 1); /* built by other threads: the same order */
        sph_grid h;
        threads(count);
        FUZZ_REQUIRE(sph_grid_build(p.dim, p.sources, p.source_radius, other, bytes, &h) == 0);
        for (i = 0; i < n; i++) FUZZ_REQUIRE(sph_grid_permutation(&g)[i] == sph_grid_permutation(&h)[i]);
        check_lists(&p, &h, count, few, share);
        check_order(&p, &g);
        free(other);
    }
    skin = SPH_R(tame ? fuzz_unit(&in) : fuzz_number(&in));
    answer = sph_rebuild_due(p.dim, p.sources, p.targets, skin);
    FUZZ_REQUIRE(answer <= 1 && answer >= SPH_ERROR_BOX);
    free(work);
    free(R);
    cloud_free(&a);
    if (foreign) cloud_free(&b);
    return 0;
}
