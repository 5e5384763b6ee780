/* SPDX-License-Identifier: MIT */
/*
 * sparse.c - fuzz target: rows assembled to CSR matrices by sph_ops.h, and sparse.h: builder, transpose, ILU(0), GMRES, BiCGStab and the estimate of the condition number, against dense matrices in long double.
 * Lists and matrices that are none must be refused.
 */
#include "fuzz.h"

#include "../../examples/common/sparse.h"
#include "../../sph_ops.h"

enum { MOST = 10 };

/* ---- assembly ---- */

static void check_assembly(fuzz_input *in)
{
    const int n = 1 + fuzz_below(in, MOST), good = fuzz_below(in, 4) != 0, drop = fuzz_below(in, 2);
    sph_index *const start = (sph_index *)fuzz_memory((size_t)n + 1, sizeof *start), *index, *begin, *column;
    sph_real *const diagonal = (sph_real *)fuzz_memory((size_t)n, sizeof *diagonal), *row, *value;
    sph_index first = (sph_index)fuzz_below(in, n + 1), last = (sph_index)fuzz_below(in, n + 1), answer, i, p;
    int64_t size, capacity, entries = -7;
    sph_cloud cloud;
    sph_list list;
    sph_csr matrix;
    int a, rows;
    if (good && first > last) {
        const sph_index swap = first;
        first = last;
        last = swap;
    }
    start[0] = good ? 0 : (sph_index)(fuzz_below(in, 4) - 1);
    for (i = 0; i < n; i++) start[i + 1] = (sph_index)(start[i] + (good ? fuzz_below(in, 6) : fuzz_below(in, 9) - 2));
    for (i = 0, a = 0; i <= n; i++) a = start[i] > a ? start[i] : a;
    index = (sph_index *)fuzz_memory((size_t)a, sizeof *index);
    row = (sph_real *)fuzz_memory((size_t)a, sizeof *row);
    for (i = 0; i < a; i++) {
        index[i] = (sph_index)(good ? fuzz_below(in, n) : fuzz_below(in, n + 3) - 1);
        row[i] = SPH_R(good ? fuzz_tame(in) : fuzz_number(in));
    }
    for (i = 0; i < n; i++) {
        diagonal[i] = SPH_R(good ? fuzz_tame(in) : fuzz_number(in));
        if (good) /* an entry of its own diagonal is refused */
            for (p = start[i]; p < start[i + 1]; p++)
                if (index[p] == i) index[p] = (sph_index)((i + 1) % n);
    }
    list.start = start;
    list.index = index;
    cloud = sph_cloud_of(sph_points_separate((sph_index)n, NULL, NULL, NULL), list, sph_scalars_none(),
                         sph_scalars_none());
    cloud = sph_cloud_range(cloud, first, last);
    size = sph_csr_size(cloud);
    capacity = fuzz_below(in, 4) ? (size > 0 ? size : 0) : fuzz_below(in, 32);
    rows = last > first ? last - first : 0;
    begin = (sph_index *)fuzz_memory((size_t)rows + 1, sizeof *begin);
    column = (sph_index *)fuzz_memory((size_t)capacity, sizeof *column);
    value = (sph_real *)fuzz_memory((size_t)capacity, sizeof *value);
    matrix.start = begin;
    matrix.column = column;
    matrix.value = value;
    matrix.capacity = capacity;
    answer = sph_csr_assemble(cloud, row, sph_scalars_array(diagonal), drop, matrix, &entries);
    FUZZ_REQUIRE(answer <= 0 && answer >= SPH_ERROR_PAIRS);
    if (good && n > 1) FUZZ_REQUIRE(answer == (capacity < size ? SPH_ERROR_CAPACITY : 0));
    if (answer == 0) {
        FUZZ_REQUIRE(begin[0] == 0 && begin[rows] == entries && entries <= size);
        for (i = first; i < last; i++) {
            long double dense[MOST] = {0}, scale[MOST] = {0};
            unsigned char used[MOST] = {0}, named[MOST] = {0};
            dense[i] = (long double)diagonal[i];
            scale[i] = fabsl(dense[i]);
            named[i] = 1;
            for (p = start[i]; p < start[i + 1]; p++) {
                dense[index[p]] += (long double)row[p];
                scale[index[p]] += fabsl((long double)row[p]);
                if (!drop || row[p] > SPH_R(0) || row[p] < SPH_R(0)) named[index[p]] = 1;
            }
            for (p = begin[i - first]; p < begin[i - first + 1]; p++) {
                const sph_index j = column[p];
                FUZZ_REQUIRE(j >= 0 && j < n && !used[j] && named[j]);
                FUZZ_REQUIRE(p == begin[i - first] || j > column[p - 1]);
                used[j] = 1;
                if (good) FUZZ_REQUIRE(fabsl((long double)value[p] - dense[j]) <= 16 * (long double)SPH_EPSILON * scale[j]);
            }
            FUZZ_REQUIRE(memcmp(used, named, sizeof used) == 0);
        }
    }
    free(start);
    free(index);
    free(row);
    free(diagonal);
    free(begin);
    free(column);
    free(value);
}

/* ---- solvers ---- */

typedef struct dense {
    int n;
    long double a[MOST][MOST];
    unsigned char stored[MOST][MOST];
} dense;

/* Returns the answer of sparse_finish. Rows may name a column twice; bad ones name columns that do not exist, or there are too many or too few. */
static int build(fuzz_input *in, int good, sparse *A, dense *D)
{
    sparse_builder b;
    const int n = good ? 1 + fuzz_below(in, MOST) : fuzz_below(in, MOST), rows = good ? n : n + fuzz_below(in, 3) - 1;
    int i, k, valid = n >= 1 && rows == n;
    const int awkward = fuzz_below(in, 4) == 0, dominant = fuzz_below(in, 2);
    memset(D, 0, sizeof *D);
    D->n = n;
    sparse_begin(&b, n, fuzz_below(in, 8));
    for (i = 0; i < rows; i++) {
        const int count = fuzz_below(in, 8);
        for (k = 0; k < count; k++) {
            const int column = good ? fuzz_below(in, n) : fuzz_below(in, MOST + 2) - 1;
            const double value = awkward ? fuzz_number(in) : fuzz_tame(in);
            sparse_put(&b, column, value);
            if (column < 0 || column >= n) valid = 0;
            else if (i < n) {
                D->a[i][column] += (long double)value;
                D->stored[i][column] = 1;
            }
        }
        if (dominant && i < n && good) {
            sparse_put(&b, i, 8.0);
            D->a[i][i] += 8.0L;
            D->stored[i][i] = 1;
        }
        sparse_end_row(&b);
    }
    k = sparse_finish(&b, A);
    FUZZ_REQUIRE((k == 0) == valid);
    if (k != 0) FUZZ_REQUIRE(!A->start && !A->index && !A->value);
    return k;
}

/* does row i of the matrix hold what it should? */
static void check_row(const sparse *A, const dense *D, int i, int transposed)
{
    int64_t k;
    int j, count = 0, stored = 0;
    for (j = 0; j < D->n; j++) stored += transposed ? D->stored[j][i] : D->stored[i][j];
    for (k = A->start[i]; k < A->start[i + 1]; k++, count++) {
        const int column = A->index[k];
        const long double want = transposed ? D->a[column][i] : D->a[i][column];
        FUZZ_REQUIRE(k == A->start[i] || column > A->index[k - 1]);
        FUZZ_REQUIRE(transposed ? D->stored[column][i] : D->stored[i][column]);
        FUZZ_REQUIRE(!(fabsl(want) < 1e3L) || !isfinite(A->value[k]) || fabsl((long double)A->value[k] - want) <= 1e-12L);
    }
    FUZZ_REQUIRE(count == stored);
}

static long double residual(const dense *D, const double *b, const double *x)
{
    long double sum = 0.0L;
    int i, j;
    for (i = 0; i < D->n; i++) {
        long double r = (long double)b[i];
        for (j = 0; j < D->n; j++)
            if (D->stored[i][j]) r -= D->a[i][j] * (long double)x[j];
        sum += r * r;
    }
    return sqrtl(sum);
}

/* L U = A where A has entries: of the product of the factors, in long double. An entry of L may be off by the least number, too, by which it underflows; so its product with one of U by that of U. */
static void check_ilu0(const sparse_preconditioner *P, const sparse *A)
{
    long double L[MOST][MOST] = {{0}}, U[MOST][MOST] = {{0}};
    int i, j, l;
    int64_t k;
    for (i = 0; i < A->n; i++) {
        L[i][i] = 1.0L;
        for (k = A->start[i]; k < A->start[i + 1]; k++) {
            if (A->index[k] < i) L[i][A->index[k]] = (long double)P->factor[k];
            else U[i][A->index[k]] = (long double)P->factor[k];
        }
    }
    for (i = 0; i < A->n; i++)
        for (k = A->start[i]; k < A->start[i + 1]; k++) {
            long double sum = 0.0L, size = 0.0L, pivots = 0.0L;
            j = A->index[k];
            for (l = 0; l < A->n; l++) {
                sum += L[i][l] * U[l][j];
                size += fabsl(L[i][l] * U[l][j]);
                pivots += fabsl(U[l][j]);
            }
            FUZZ_REQUIRE(!(size < 1e290L) || fabsl(sum - (long double)A->value[k]) <= 64 * 2.3e-16L * (size + fabsl((long double)A->value[k])) + 5e-324L * pivots + 1e-300L);
        }
}

/* |A^-1| in the 1-norm, or -1 */
static long double inverse_norm(const dense *D)
{
    long double w[MOST][2 * MOST], largest = 0.0L;
    int i, j, c;
    for (i = 0; i < D->n; i++)
        for (j = 0; j < 2 * D->n; j++) w[i][j] = j < D->n ? D->a[i][j] : (long double)(j - D->n == i);
    for (c = 0; c < D->n; c++) {
        int best = c;
        for (i = c + 1; i < D->n; i++)
            if (fabsl(w[i][c]) > fabsl(w[best][c])) best = i;
        if (!(fabsl(w[best][c]) > 1e-9L)) return -1.0L;
        for (j = 0; j < 2 * D->n; j++) {
            const long double t = w[c][j];
            w[c][j] = w[best][j];
            w[best][j] = t;
        }
        for (i = 0; i < D->n; i++) {
            const long double factor = w[i][c] / w[c][c];
            for (j = 0; i != c && j < 2 * D->n; j++) w[i][j] -= factor * w[c][j];
        }
    }
    for (j = 0; j < D->n; j++) {
        long double sum = 0.0L;
        for (i = 0; i < D->n; i++) sum += fabsl(w[i][D->n + j] / w[i][i]);
        largest = sum > largest ? sum : largest;
    }
    return largest;
}

static void check_solution(const dense *D, const sparse *A, const double *b, const double *x, sparse_result r, const sparse_options *o)
{
    long double norm = 0.0L, size = 0.0L;
    int i, j;
    for (i = 0; i < A->n; i++) {
        FUZZ_REQUIRE(isfinite(x[i]));
        norm += (long double)b[i] * (long double)b[i];
        for (j = 0; j < A->n; j++)
            if (D->stored[i][j]) size += fabsl(D->a[i][j] * (long double)x[j]);
    }
    FUZZ_REQUIRE(isfinite(r.residual) && r.residual >= 0.0);
    FUZZ_REQUIRE(r.iterations >= 0 && r.iterations <= o->max_iterations + 1);
    FUZZ_REQUIRE((r.status == SPARSE_CONVERGED) == (r.converged != 0) && sparse_status_text(r.status)[0]);
    norm = sqrtl(norm);
    if (r.converged && norm > 1e-100L && norm < 1e100L) FUZZ_REQUIRE(residual(D, b, x) <= 1.0001L * (long double)o->tolerance * norm + 1e-14L * (size + norm));
}

static void check_solvers(fuzz_input *in, const sparse *A, const dense *D, int refused)
{
    const int restarts[] = {0, 1, 3, 50}, most[] = {0, 1, 7, 200}, method = fuzz_below(in, 3), awkward = fuzz_below(in, 8) == 0;
    double *const b = (double *)fuzz_memory((size_t)A->n, sizeof *b), *const x = (double *)fuzz_memory((size_t)A->n, sizeof *x), *history;
    sparse_options o = sparse_defaults();
    sparse_preconditioner P;
    int i, made;
    o.restart = restarts[fuzz_below(in, 4)];
    o.max_iterations = most[fuzz_below(in, 4)];
    o.tolerance = pow(10.0, -fuzz_below(in, 18));
    history = (double *)fuzz_memory((size_t)o.max_iterations + 2, sizeof *history);
    o.history = history;
    made = sparse_preconditioner_make(&P, (sparse_method)method, A);
    if (refused) FUZZ_REQUIRE(made == -2);
    if (made == 0 && method == SPARSE_ILU0) check_ilu0(&P, A);
    if (made != 0) FUZZ_REQUIRE(P.method == SPARSE_NONE && !P.factor && !P.inverse && !P.diagonal);
    for (i = 0; i < A->n; i++) {
        b[i] = awkward ? fuzz_number(in) : fuzz_tame(in);
        x[i] = awkward ? fuzz_number(in) : 0.0;
    }
    check_solution(D, A, b, x, sparse_gmres(A, &P, b, x, &o), &o);
    for (i = 0; i < A->n; i++) x[i] = 0.0;
    check_solution(D, A, b, x, sparse_bicgstab(A, &P, b, x, &o), &o);
    sparse_preconditioner_free(&P);
    free(b);
    free(x);
    free(history);
}

static void check_condition(const sparse *A, const dense *D)
{
    sparse_options o = sparse_defaults();
    const long double inverse = inverse_norm(D);
    sparse_condition c;
    o.tolerance = 1e-8;
    c = sparse_condition_estimate(A, &o);
    FUZZ_REQUIRE(!isnan(c.condition) && c.condition >= 0.0);
    if (c.converged && inverse > 0.0L && inverse < 1e6L) FUZZ_REQUIRE((long double)c.inverse_norm <= inverse * 1.001L && (long double)c.inverse_norm >= 0.01L * inverse);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    const int what = fuzz_below(&in, 4);
    sparse A, T;
    dense D;
    if (what == 0) check_assembly(&in);
    else if (build(&in, what != 1, &A, &D) == 0) {
        const int refused = sparse_check(&A) != 0;
        int i;
        FUZZ_REQUIRE(sparse_transpose(&A, &T) == 0);
        for (i = 0; i < A.n; i++) {
            check_row(&A, &D, i, 0);
            check_row(&T, &D, i, 1);
        }
        if (what == 2 && !refused) check_condition(&A, &D);
        check_solvers(&in, &A, &D, refused);
        sparse_free(&A);
        sparse_free(&T);
    }
    return 0;
}
