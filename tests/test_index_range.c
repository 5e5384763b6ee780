/* SPDX-License-Identifier: MIT */
/*
 * test_index_range.c - clouds and lists that fill the range of sph_index, which has 16 bits here so that they fit anywhere: sizes that do not fit are refused, loops that go by tiles end.
 */
#include "one_copy.h"
#if defined(__GNUC__) || defined(__clang__)
#pragma GCC diagnostic ignored "-Wconversion" /* sums of 16-bit numbers are ints */
#endif
#include <stdint.h>
#define SPH_INDEX int16_t

#include "../sph.h"
#include "check.h"
#include "clouds.h"

enum { MOST = 32767, TILE = 64 };

/* ---- the search ---- */

/* A line of n particles whose spacing is `apart`; the pairs that are nearer than 1. */
static int64_t line_pairs(sph_index n, double apart, sph_index *answer, int *wrong)
{
    const size_t size = sph_grid_workspace(1, n), room = MOST;
    sph_real *const x = (sph_real *)cloud_memory((size_t)n, sizeof *x), one = SPH_R(1);
    sph_index *const start = (sph_index *)cloud_memory((size_t)n + 1, sizeof *start), *const index = (sph_index *)cloud_memory(room, sizeof *index);
    void *const work = cloud_memory(size, 1);
    const sph_scalars R = sph_scalars_same(&one);
    sph_points p = sph_points_separate(n, x, 0, 0);
    int64_t pairs = -1;
    sph_grid g;
    int i, q;
    for (i = 0; i < n; i++) x[i] = SPH_R(i * apart);
    *wrong = 0;
    *answer = sph_grid_build(1, p, R, work, size, &g);
    if (*answer == 0) *answer = sph_grid_lists(1, &g, sph_query_of(p, SPH_GATHER, R, 0), start, index, (int64_t)room, &pairs);
    for (i = 0; *answer == 0 && i < n; i++)
        for (q = start[i]; q < start[i + 1]; q++) *wrong += !(fabs((double)x[i] - (double)x[index[q]]) < 1.0) || index[q] == i;
    free(x);
    free(start);
    free(index);
    free(work);
    return pairs;
}

static void test_search(void)
{
    sph_index answer, n;
    int wrong;
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        CHECK(sph_grid_workspace(dim, MOST) == 0);
        CHECK(sph_grid_workspace(dim, MOST - TILE + 1) == 0);
        CHECK(sph_grid_workspace(dim, MOST - TILE) > 0);
    }
    n = MOST - TILE;
    CHECK(line_pairs(n, 2.0, &answer, &wrong) == 0 && answer == 0);
    n = MOST / 2;
    CHECK(line_pairs(n, 0.75, &answer, &wrong) == 2 * (n - 1) && answer == 0 && wrong == 0);
    n = MOST / 2 + 1; /* 2 (n - 1) is what there is room for, less 1 */
    CHECK(line_pairs(n, 0.75, &answer, &wrong) == 2 * (n - 1) && answer == 0 && wrong == 0);
    n = MOST / 2 + 2;
    CHECK(line_pairs(n, 0.75, &answer, &wrong) >= 2 * (n - 1) && answer == SPH_ERROR_PAIRS);
    n = MOST - TILE;
    CHECK(line_pairs(n, 0.75, &answer, &wrong) >= 2 * (n - 1) && answer == SPH_ERROR_PAIRS);
}

/* Random particles with more pairs than can be counted: the same bound whatever the room, the order and the number of threads. */
static void test_too_many(void)
{
    enum { N = 2000 };
    static const int rooms[] = {0, 1, 1000, MOST};
    sph_real *const R = (sph_real *)cloud_memory(N, sizeof *R);
    const size_t size = sph_grid_workspace(2, N);
    sph_real *const x = (sph_real *)cloud_memory(N, sizeof *x), *const y = (sph_real *)cloud_memory(N, sizeof *y);
    sph_index *const start = (sph_index *)cloud_memory(N + 1, sizeof *start), *const index = (sph_index *)cloud_memory(MOST, sizeof *index);
    void *const work = cloud_memory(size, 1);
    const sph_points p = sph_points_separate(N, x, y, 0);
    int64_t bound = 0, pairs, counted = 0;
    int i, j, k, turn;
    pcg32 random;
    pcg32_seed(&random, 15, 3);
    for (i = 0; i < N; i++) {
        x[i] = SPH_R(pcg32_uniform(&random));
        y[i] = SPH_R(pcg32_uniform(&random));
    }
    for (i = 0; i < N; i++)
        for (j = 0; j < N; j++) counted += i != j && hypot((double)x[i] - (double)x[j], (double)y[i] - (double)y[j]) < 0.2;
    CHECK(counted > MOST + 9 * N); /* also if nine of them saw nothing */
    for (turn = 0; turn < 4; turn++) {
        const sph_scalars radius = turn < 2 ? sph_scalars_same(R) : sph_scalars_array(R);
        sph_grid g;
        for (i = 0; i < N; i++) R[i] = SPH_R(i > 0 && i < 9 ? 0.02 : 0.2);
        CHECK(sph_grid_build(2, p, radius, work, size, &g) == 0 && (g.levels > 0) == (turn > 1));
        if (turn == 2) bound = 0;
        for (k = 0; k < 12; k++) {
            pairs = -1;
#if SPH_OPENMP
            omp_set_num_threads(1 + k / 4 * 3);
#endif
            CHECK(sph_grid_lists(2, &g, sph_query_of(p, SPH_GATHER, radius, 0), start, rooms[k % 4] ? index : 0, rooms[k % 4], &pairs) ==
                  SPH_ERROR_PAIRS);
            if (bound == 0) bound = pairs;
            CHECK(pairs == bound && pairs >= counted);
        }
        for (i = 0; i < N / 2; i++) { /* the other way round */
            const sph_real kept_x = x[i], kept_y = y[i];
            x[i] = x[N - 1 - i];
            y[i] = y[N - 1 - i];
            x[N - 1 - i] = kept_x;
            y[N - 1 - i] = kept_y;
        }
    }
    free(x);
    free(y);
    free(R);
    free(start);
    free(index);
    free(work);
}

/* ---- sweeps: one row that ends with the last index there is ---- */

static void test_sweep(sph_index length)
{
    enum { N = 401, I = N / 2 };
    sph_real x[N], f[N], gx[N], hxx[N], row_diagonal[N], *const row = (sph_real *)cloud_memory(MOST, sizeof *row), V = SPH_R(0.01), h = SPH_R(1);
    sph_index start[N + 1], *const index = (sph_index *)cloud_memory(MOST, sizeof *index);
    const sph_list list = {start, index};
    const sph_points p = sph_points_separate(N, x, 0, 0);
    const sph_cloud all = sph_cloud_of(p, list, sph_scalars_same(&h), sph_scalars_same(&V)),
                    one = sph_cloud_range(all, I, I + 1);
    sph_derivatives_out out = {0};
    sph_rows_out rows = {0};
    double sum = 0;
    int i, q;
    for (i = 0; i < N; i++) {
        x[i] = SPH_R(0.01 * (i - I));
        f[i] = SPH_R(3) * x[i] * x[i] + SPH_R(2) * x[i];
    }
    for (i = 0; i <= N; i++) start[i] = (sph_index)(i <= I ? MOST - length : MOST);
    for (q = 0; q < MOST; q++) index[q] = (sph_index)((I + 1 + q % (N - 1)) % N); /* all the others, many times over */
    out.gx = gx;
    out.hxx = hxx;
    rows.row = row;
    rows.diagonal = row_diagonal;
    CHECK(sph_derivatives_wls(SPH_WENDLAND_C4, 1, one, sph_scalars_array(f), (sph_derivatives_options){0}, out) == 0);
    CHECK_CLOSE((double)gx[I], 2.0, 1e4 * (double)SPH_EPSILON);
    CHECK_CLOSE((double)hxx[I], 6.0, 1e4 * (double)SPH_EPSILON);
    CHECK(sph_derivatives_rows_wls(SPH_WENDLAND_C4, 1, one, sph_jet_laplacian(1), rows) == 0);
    for (q = start[I]; q < start[I + 1]; q++) sum += (double)row[q] * ((double)f[index[q]] - (double)f[I]);
    CHECK_CLOSE(sum, 6.0, 1e4 * (double)SPH_EPSILON);
    free(row);
    free(index);
}

/* A matrix with more entries than can be counted, one for each entry of the lists and for each diagonal. */
static void test_matrix(sph_index length, sph_index expected)
{
    enum { N = 3 };
    sph_real diagonal[N] = {0, 0, 0}, *const row = (sph_real *)cloud_memory(MOST, sizeof *row),
             *const value = (sph_real *)cloud_memory(MOST, sizeof *value);
    sph_index start[N + 1], begin[N + 1], *const index = (sph_index *)cloud_memory(MOST, sizeof *index),
                                          *const column = (sph_index *)cloud_memory(MOST, sizeof *column);
    sph_list list;
    sph_cloud targets;
    sph_csr out;
    sph_real x[N] = {0, 1, 2};
    int64_t entries = -1;
    int q;
    start[0] = 0;
    for (q = 0; q < N; q++) start[q + 1] = length;
    for (q = 0; q < MOST; q++) {
        index[q] = 1;
        row[q] = SPH_R(1);
    }
    list.start = start;
    list.index = index;
    targets = sph_cloud_of(sph_points_separate(N, x, 0, 0), list, sph_scalars_none(), sph_scalars_none());
    out.start = begin;
    out.column = column;
    out.value = value;
    out.capacity = INT64_MAX;
    CHECK(sph_csr_size(targets) == (int64_t)length + N);
    CHECK(sph_csr_assemble(targets, row, sph_scalars_array(diagonal), 0, out, &entries) == expected);
    CHECK(entries == (expected ? -1 : N + 1)); /* a neighbour that is named often is one entry */
    out.capacity = (int64_t)length + N - 1;
    CHECK(sph_csr_assemble(targets, row, sph_scalars_array(diagonal), 0, out, &entries) ==
          (expected ? expected : SPH_ERROR_CAPACITY));
    free(row);
    free(value);
    free(index);
    free(column);
}

int main(void)
{
    test_matrix(MOST - 3, 0);
    test_matrix(MOST - 2, SPH_ERROR_PAIRS);
    test_search();
    test_too_many();
    test_sweep(MOST);
    test_sweep(MOST - 1);
    test_sweep(1000); /* several tiles, the last one not full */
    return check_report("test_index_range");
}
