/* SPDX-License-Identifier: MIT */
/* test_sparse - examples/common/sparse.h against dense elimination, known factors, and systems that cannot be solved. With HAVE_PETSC=1 (tests/petsc.sh)
 * sparse_petsc.h, too. */
#include "check.h"

#include "../examples/common/random.h"
#include "../examples/common/sparse.h"
#include "../examples/common/sparse_petsc.h"

enum { MOST = 64 }; /* rows of the dense matrices */

/* ---- dense reference --------------------------------------------------- */

typedef struct dense {
    int n;
    double a[MOST][MOST];
} dense;

static dense zero_dense(int n)
{
    dense D;
    memset(&D, 0, sizeof D);
    D.n = n;
    return D;
}

/* Gaussian elimination with partial pivoting; returns 0 if a pivot is 0. */
static int dense_solve(dense D, const double *b, double *x)
{
    const int n = D.n;
    for (int i = 0; i < n; ++i) x[i] = b[i];
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i)
            if (fabs(D.a[i][k]) > fabs(D.a[pivot][k])) pivot = i;
        if (D.a[pivot][k] == 0.0) return 0;
        for (int j = 0; j < n; ++j) {
            const double t = D.a[k][j];
            D.a[k][j] = D.a[pivot][j];
            D.a[pivot][j] = t;
        }
        const double t = x[k];
        x[k] = x[pivot];
        x[pivot] = t;
        for (int i = k + 1; i < n; ++i) {
            const double l = D.a[i][k] / D.a[k][k];
            for (int j = k; j < n; ++j) D.a[i][j] -= l * D.a[k][j];
            x[i] -= l * x[k];
        }
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int j = i + 1; j < n; ++j) x[i] -= D.a[i][j] * x[j];
        x[i] /= D.a[i][i];
    }
    return 1;
}

static void dense_multiply(const dense *D, const double *x, double *y)
{
    for (int i = 0; i < D->n; ++i) {
        y[i] = 0.0;
        for (int j = 0; j < D->n; ++j) y[i] += D->a[i][j] * x[j];
    }
}

static double largest_difference(int n, const double *x, const double *y)
{
    double largest = 0.0;
    for (int i = 0; i < n; ++i) largest = fabs(x[i] - y[i]) <= largest ? largest : fabs(x[i] - y[i]); /* a NaN stays */
    return largest;
}

/* The entries that are not 0, each in two parts and from right to left, so that the builder has something to do. */
static sparse from_dense(const dense *D)
{
    sparse_builder build;
    sparse A;
    sparse_begin(&build, D->n, 0);
    for (int i = 0; i < D->n; ++i) {
        for (int part = 0; part < 2; ++part)
            for (int j = D->n - 1; j >= 0; --j)
                if (D->a[i][j] != 0.0) sparse_put(&build, j, part ? 0.75 * D->a[i][j] : 0.25 * D->a[i][j]);
        sparse_end_row(&build);
    }
    if (sparse_finish(&build, &A) != 0) {
        fprintf(stderr, "test_sparse: no memory\n");
        exit(2);
    }
    return A;
}

/* Entries in (-1, 1) with the given density. dominance: the diagonal is that many times the sum of the others of its row, of either sign; 0: random as well. */
static dense random_dense(int n, double density, double dominance, pcg32 *g)
{
    dense D = zero_dense(n);
    for (int i = 0; i < n; ++i) {
        double sum = 0.1;
        for (int j = 0; j < n; ++j) {
            if (j != i && pcg32_uniform(g) < density) D.a[i][j] = 2.0 * pcg32_uniform(g) - 1.0;
            sum += fabs(D.a[i][j]);
        }
        const double sign = pcg32_uniform(g) < 0.5 ? -1.0 : 1.0;
        D.a[i][i] = sign * (dominance > 0.0 ? dominance * sum : 0.5 + pcg32_uniform(g));
    }
    return D;
}

static void random_vector(int n, double *x, pcg32 *g)
{
    for (int i = 0; i < n; ++i) x[i] = 2.0 * pcg32_uniform(g) - 1.0;
}

static double dense_residual(const dense *D, const double *x, const double *b)
{
    double r[MOST], square = 0.0, b_square = 0.0;
    dense_multiply(D, x, r);
    for (int i = 0; i < D->n; ++i) {
        square += (b[i] - r[i]) * (b[i] - r[i]);
        b_square += b[i] * b[i];
    }
    return sqrt(square / b_square);
}

static dense tridiagonal(int n, double below, double diagonal, double above)
{
    dense D = zero_dense(n);
    for (int i = 0; i < n; ++i) {
        D.a[i][i] = diagonal;
        if (i > 0) D.a[i][i - 1] = below;
        if (i < n - 1) D.a[i][i + 1] = above;
    }
    return D;
}

/* A x = x one place further: GMRES makes no progress before step n. */
static dense cyclic_shift(int n)
{
    dense D = zero_dense(n);
    for (int i = 0; i < n; ++i) D.a[i][(i + 1) % n] = 1.0;
    return D;
}

/* ---- the matrix -------------------------------------------------------- */

static void test_matrix(void)
{
    static const int size[] = {1, 2, 5, 17, MOST};
    pcg32 g;
    pcg32_seed(&g, 1, 1);
    for (int s = 0; s < 5; ++s) {
        const int n = size[s];
        const dense D = random_dense(n, 0.4, 0.0, &g);
        double x[MOST], y[MOST], z[MOST];
        sparse A = from_dense(&D), T;
        CHECK(sparse_check(&A) == 0);
        int64_t entries = 0;
        double norm = 0.0;
        for (int j = 0; j < n; ++j) {
            double sum = 0.0;
            for (int i = 0; i < n; ++i) {
                entries += D.a[i][j] != 0.0;
                sum += fabs(D.a[i][j]);
            }
            norm = fmax(norm, sum);
        }
        CHECK(A.start[n] == entries);
        CHECK_RELATIVE(sparse_norm1(&A), norm, 1e-14);
        random_vector(n, x, &g);
        sparse_multiply(&A, x, y);
        dense_multiply(&D, x, z);
        CHECK_CLOSE(largest_difference(n, y, z), 0.0, 1e-13);

        CHECK(sparse_transpose(&A, &T) == 0 && sparse_check(&T) == 0);
        dense D_T = D;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) D_T.a[i][j] = D.a[j][i];
        sparse_multiply(&T, x, y);
        dense_multiply(&D_T, x, z);
        CHECK_CLOSE(largest_difference(n, y, z), 0.0, 1e-13);
        for (int i = 0; i < n; ++i) {
            const int64_t d = sparse_diagonal(&A, i);
            CHECK(d >= 0 && A.index[d] == i && A.value[d] == D.a[i][i]);
        }
        sparse_free(&T);
        sparse_free(&A);
    }
}

static void test_builder_errors(void)
{
    for (int wrong = 0; wrong < 5; ++wrong) { /* column -1, column n, a row too few, a row too many, n = 0; 5 would be right */
        sparse_builder build;
        sparse A;
        sparse_begin(&build, wrong == 4 ? 0 : 2, 0);
        sparse_put(&build, wrong == 0 ? -1 : wrong == 1 ? 2 : 0, 1.0);
        sparse_end_row(&build);
        for (int row = 1; row < (wrong == 2 ? 1 : wrong == 3 ? 3 : 2); ++row) {
            sparse_put(&build, 1, 1.0);
            sparse_end_row(&build);
        }
        CHECK(sparse_finish(&build, &A) == -2);
        CHECK(A.n == 0 && !A.start && !A.index && !A.value);
    }

    const dense D = tridiagonal(4, -1.0, 2.0, -1.0);
    sparse A = from_dense(&D);
    CHECK(sparse_check(&A) == 0);
    A.index[3] = 4;
    CHECK(sparse_check(&A) == 2); /* out of range */
    A.index[3] = 0;
    CHECK(sparse_check(&A) == 2); /* twice the same */
    A.index[3] = 1;
    A.value[9] = (double)NAN;
    CHECK(sparse_check(&A) == 4);
    A.value[9] = 2.0;
    A.start[2] = 1;
    CHECK(sparse_check(&A) == 2); /* a row of negative length */
    A.start[2] = 5;
    CHECK(sparse_check(&A) == 0);
    sparse_free(&A);
}

static void test_scaling(void)
{
    pcg32 g;
    pcg32_seed(&g, 2, 1);
    dense D = random_dense(20, 0.3, 0.0, &g);
    double b[MOST], x[MOST], y[MOST];
    random_vector(20, b, &g);
    CHECK(dense_solve(D, b, x));
    sparse A = from_dense(&D);
    CHECK(sparse_scale_rows(&A, b) == 0);
    for (int i = 0; i < 20; ++i) CHECK(A.value[sparse_diagonal(&A, i)] == 1.0);
    sparse_multiply(&A, x, y);
    CHECK_CLOSE(largest_difference(20, y, b), 0.0, 1e-11);
    sparse_free(&A);

    A = from_dense(&D);
    A.value[sparse_diagonal(&A, 7)] = 0.0;
    random_vector(20, b, &g);
    memcpy(y, b, sizeof y);
    CHECK(sparse_scale_rows(&A, b) == 8);
    CHECK(memcmp(y, b, 20 * sizeof *b) == 0 && A.value[sparse_diagonal(&A, 0)] == D.a[0][0]);
    sparse_free(&A);
    D.a[7][7] = 0.0;
    A = from_dense(&D);
    CHECK(sparse_scale_rows(&A, NULL) == 8);
    sparse_free(&A);
}

/* ---- preconditioners --------------------------------------------------- */

/* L U as a dense matrix, from how the preconditioner solves: column j of (L U)^-1 is what it makes of the unit vector j. */
static dense inverse_of(const sparse_preconditioner *P, int n)
{
    dense D = zero_dense(n);
    double e[MOST], z[MOST];
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) e[i] = i == j;
        sparse_precondition(P, n, e, z);
        for (int i = 0; i < n; ++i) D.a[i][j] = z[i];
    }
    return D;
}

/* Where elimination fills nothing, ILU(0) is LU, and one step solves the system. */
static void test_ilu0_exact(void)
{
    pcg32 g;
    pcg32_seed(&g, 3, 1);
    for (int form = 0; form < 5; ++form) {
        dense D = random_dense(40, 0.99, 1.5, &g);
        for (int i = 0; i < 40; ++i)
            for (int j = 0; j < 40; ++j) {
                const int keep = i == j || (form == 0   ? abs(i - j) == 1    /* tridiagonal */
                                            : form == 1 ? i == 39 || j == 39 /* an arrow */
                                            : form == 2 ? i > j              /* lower */
                                            : form == 3 ? i < j              /* upper */
                                                        : i / 8 == j / 8);   /* blocks */
                if (!keep) D.a[i][j] = 0.0;
            }
        double b[MOST], x[MOST], y[MOST];
        sparse A = from_dense(&D);
        sparse_preconditioner P;
        random_vector(40, b, &g);
        CHECK(dense_solve(D, b, y));
        CHECK(sparse_preconditioner_make(&P, SPARSE_ILU0, &A) == 0);
        sparse_precondition(&P, 40, b, x);
        CHECK_CLOSE(largest_difference(40, x, y), 0.0, 1e-13);
        const sparse_options o = sparse_defaults();
        memset(x, 0, sizeof x);
        sparse_result r = sparse_gmres(&A, &P, b, x, &o);
        CHECK(r.converged && r.iterations == 1);
        memset(x, 0, sizeof x);
        r = sparse_bicgstab(&A, &P, b, x, &o);
        CHECK(r.converged && r.iterations == 1);
        CHECK_CLOSE(largest_difference(40, x, y), 0.0, 1e-9);
        sparse_preconditioner_free(&P);
        sparse_free(&A);
    }
}

/* Elsewhere L U = A holds on the pattern of A, and that defines ILU(0). */
static void test_ilu0_on_pattern(void)
{
    pcg32 g;
    pcg32_seed(&g, 4, 1);
    const int n = 30;
    const dense D = random_dense(n, 0.2, 1.5, &g);
    sparse A = from_dense(&D);
    sparse_preconditioner P;
    CHECK(sparse_preconditioner_make(&P, SPARSE_ILU0, &A) == 0);
    const dense inverse = inverse_of(&P, n);
    double elsewhere = 0.0, pattern = 0.0;
    for (int j = 0; j < n; ++j) {
        double e[MOST], column[MOST];
        for (int i = 0; i < n; ++i) e[i] = i == j;
        CHECK(dense_solve(inverse, e, column)); /* column j of L U */
        for (int i = 0; i < n; ++i) {
            const double difference = fabs(column[i] - D.a[i][j]);
            if (D.a[i][j] != 0.0) pattern = fmax(pattern, difference);
            else elsewhere = fmax(elsewhere, difference);
        }
    }
    CHECK_CLOSE(pattern, 0.0, 1e-12);
    CHECK(elsewhere > 0.01); /* there is fill that it drops, or this test would say nothing */
    sparse_preconditioner_free(&P);

    CHECK(sparse_preconditioner_make(&P, SPARSE_JACOBI, &A) == 0);
    const dense jacobi = inverse_of(&P, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) CHECK_CLOSE(jacobi.a[i][j] * D.a[i][i], i == j, 1e-15);
    sparse_preconditioner_free(&P);
    sparse_free(&A);
}

static int make_status(const dense *D, sparse_method method)
{
    sparse A = from_dense(D);
    sparse_preconditioner P;
    const int status = sparse_preconditioner_make(&P, method, &A);
    double r[MOST], z[MOST];
    for (int i = 0; i < D->n; ++i) r[i] = 1.0 + i;
    sparse_precondition(&P, D->n, r, z);
    if (status != 0) CHECK(memcmp(r, z, (size_t)D->n * sizeof *r) == 0); /* it does nothing, and no harm */
    sparse_preconditioner_free(&P);
    sparse_free(&A);
    return status;
}

static void test_zero_pivots(void)
{
    dense D = tridiagonal(6, -1.0, 2.0, -1.0);
    CHECK(make_status(&D, SPARSE_ILU0) == 0 && make_status(&D, SPARSE_JACOBI) == 0);
    D.a[3][3] = 0.0; /* not stored: both refuse */
    CHECK(make_status(&D, SPARSE_ILU0) == 4 && make_status(&D, SPARSE_JACOBI) == 4);
    memset(D.a[3], 0, sizeof D.a[3]); /* an empty row */
    CHECK(make_status(&D, SPARSE_ILU0) == 4 && make_status(&D, SPARSE_JACOBI) == 4);

    D = tridiagonal(2, 1.0, 1.0, 1.0); /* the pivot of row 2 is 1 - 1 */
    CHECK(make_status(&D, SPARSE_ILU0) == 2 && make_status(&D, SPARSE_JACOBI) == 0);
    D.a[1][1] = 1.0 + DBL_EPSILON; /* or all but: still noise */
    CHECK(make_status(&D, SPARSE_ILU0) == 2);
    D.a[1][1] = 1.0 + 1e-12; /* small, but it means something */
    CHECK(make_status(&D, SPARSE_ILU0) == 0);

    D = tridiagonal(5, -1.0, 2.0, -1.0);
    D.a[0][0] = D.a[4][4] = 1.0; /* no flow through the ends: singular, and the last pivot shows it */
    CHECK(make_status(&D, SPARSE_ILU0) == 5);

    sparse A = from_dense(&D);
    A.value[0] = (double)INFINITY;
    sparse_preconditioner P;
    CHECK(sparse_preconditioner_make(&P, SPARSE_ILU0, &A) == -2);
    sparse_free(&A);
}

/* ---- solvers ----------------------------------------------------------- */

typedef sparse_result (*solver)(const sparse *, const sparse_preconditioner *, const double *, double *, const sparse_options *);

static void compare_with_dense(const dense *D, solver solve, int restart, sparse_method method, double tolerance, pcg32 *g)
{
    const int n = D->n;
    double b[MOST], x[MOST], y[MOST];
    sparse A = from_dense(D);
    sparse_preconditioner P;
    sparse_options o = sparse_defaults();
    o.tolerance = 1e-12;
    o.restart = restart;
    random_vector(n, b, g);
    random_vector(n, x, g); /* any first guess will do */
    CHECK(dense_solve(*D, b, y));
    CHECK(sparse_preconditioner_make(&P, method, &A) == 0);
    const sparse_result r = solve(&A, &P, b, x, &o);
    CHECK(r.converged && r.status == SPARSE_CONVERGED && r.residual <= 1e-12);
    CHECK_CLOSE(r.residual, dense_residual(D, x, b), 1e-13);
    double size = 0.0;
    for (int i = 0; i < n; ++i) size = fmax(size, fabs(y[i]));
    CHECK_CLOSE(largest_difference(n, x, y), 0.0, tolerance * size);
    sparse_preconditioner_free(&P);
    sparse_free(&A);
}

static void test_solutions(void)
{
    static const int size[] = {1, 2, 3, 10, 33, MOST};
    pcg32 g;
    pcg32_seed(&g, 5, 1);
    for (int s = 0; s < 6; ++s)
        for (int method = SPARSE_NONE; method <= SPARSE_ILU0; ++method) {
            const dense D = random_dense(size[s], 0.3, 1.2, &g);
            compare_with_dense(&D, sparse_gmres, 25, (sparse_method)method, 1e-10, &g);
            /* without help BiCGStab cannot be expected to solve a matrix whose eigenvalues lie on both sides of 0 */
            if (method != SPARSE_NONE) compare_with_dense(&D, sparse_bicgstab, 0, (sparse_method)method, 1e-10, &g);
            const dense any = random_dense(size[s], 0.3, 0.0, &g);
            compare_with_dense(&any, sparse_gmres, 0, method == SPARSE_ILU0 ? SPARSE_JACOBI : (sparse_method)method, 1e-6, &g);
        }
    for (int s = 3; s < 6; ++s) { /* convection and diffusion: nonsymmetric, and as it comes in practice */
        const dense D = tridiagonal(size[s], -1.6, 2.0, -0.4);
        for (int method = SPARSE_NONE; method <= SPARSE_ILU0; ++method) {
            compare_with_dense(&D, sparse_gmres, 25, (sparse_method)method, 1e-8, &g);
            compare_with_dense(&D, sparse_bicgstab, 0, (sparse_method)method, 1e-8, &g);
        }
    }
}

typedef struct seen {
    int calls;
    double history[2 * MOST];
} seen;

static void see(void *context, int iteration, double residual)
{
    seen *s = (seen *)context;
    s->history[iteration] = residual;
    ++s->calls;
}

/* The recorded residual is that of the system, whatever the preconditioner: stopping after k iterations must leave what the history says. It never rises, and
 * full GMRES needs no more than n steps. */
static void test_history(void)
{
    pcg32 g;
    pcg32_seed(&g, 6, 1);
    const int n = 30;
    for (int method = SPARSE_NONE; method <= SPARSE_ILU0; ++method)
        for (int restart = 0; restart <= 7; restart += 7) {
            const dense D = random_dense(n, 0.5, 0.7, &g);
            double b[MOST], x[MOST], history[2 * MOST + 1];
            sparse A = from_dense(&D);
            sparse_preconditioner P;
            seen s;
            sparse_options o = sparse_defaults();
            CHECK(sparse_preconditioner_make(&P, (sparse_method)method, &A) == 0);
            random_vector(n, b, &g);
            memset(&s, 0, sizeof s);
            memset(x, 0, sizeof x);
            o.tolerance = 1e-11;
            o.max_iterations = 2 * MOST - 1;
            o.restart = restart;
            o.history = history;
            o.monitor = see;
            o.context = &s;
            const sparse_result r = sparse_gmres(&A, &P, b, x, &o);
            if (restart == 0) CHECK(r.converged && r.iterations <= n);
            CHECK(s.calls == r.iterations + 1);
            CHECK(history[0] == 1.0 && history[r.iterations] == r.residual);
            for (int k = 0; k < r.iterations; ++k) {
                CHECK(history[k + 1] <= history[k] * (1.0 + 1e-9) + 1e-14);
                CHECK_CLOSE(s.history[k], history[k], 0.0);
            }

            o.history = NULL;
            o.monitor = NULL;
            for (int k = 0; k <= r.iterations; k += 3) {
                o.max_iterations = k;
                memset(x, 0, sizeof x);
                const sparse_result part = sparse_gmres(&A, &P, b, x, &o);
                CHECK(part.iterations == k && part.converged == (k == r.iterations && r.converged));
                CHECK(part.converged || part.status == SPARSE_TOO_FEW_ITERATIONS);
                CHECK_CLOSE(dense_residual(&D, x, b), history[k], 1e-10 * history[k] + 1e-14);
                CHECK_CLOSE(part.residual, history[k], 1e-10 * history[k] + 1e-14);
            }
            sparse_preconditioner_free(&P);
            sparse_free(&A);
        }
}

/* The same for BiCGStab, whose history may rise. */
static void test_history_bicgstab(void)
{
    const dense D = tridiagonal(40, -1.3, 2.1, -0.7);
    double b[MOST], x[MOST], history[2 * MOST + 1];
    pcg32 g;
    pcg32_seed(&g, 7, 1);
    random_vector(40, b, &g);
    sparse A = from_dense(&D);
    sparse_options o = sparse_defaults();
    o.max_iterations = 2 * MOST;
    o.history = history;
    memset(x, 0, sizeof x);
    const sparse_result r = sparse_bicgstab(&A, NULL, b, x, &o);
    CHECK(r.converged && r.iterations > 10);
    CHECK(history[0] == 1.0 && history[r.iterations] == r.residual);
    o.history = NULL;
    for (int k = 0; k < r.iterations; k += 4) {
        o.max_iterations = k;
        memset(x, 0, sizeof x);
        const sparse_result part = sparse_bicgstab(&A, NULL, b, x, &o);
        CHECK(!part.converged && part.status == SPARSE_TOO_FEW_ITERATIONS && part.iterations == k);
        CHECK_RELATIVE(dense_residual(&D, x, b), history[k], 1e-6);
        CHECK_RELATIVE(part.residual, history[k], 1e-6);
    }
    sparse_free(&A);
}

/* The worst case for GMRES: nothing happens for n - 1 steps. Restarted, it can never solve it, and must say so. */
static void test_cyclic_shift(void)
{
    const dense D = cyclic_shift(12);
    double b[MOST] = {1.0}, x[MOST] = {0.0}, history[1001];
    sparse A = from_dense(&D);
    sparse_options o = sparse_defaults();
    o.restart = 0;
    o.history = history;
    sparse_result r = sparse_gmres(&A, NULL, b, x, &o);
    CHECK(r.converged && r.iterations == 12);
    CHECK(x[1] == 1.0);
    for (int k = 0; k < 12; ++k) CHECK_CLOSE(history[k], 1.0, 1e-14);
    CHECK(history[12] < 1e-14);

    o.restart = 11;
    memset(x, 0, sizeof x);
    r = sparse_gmres(&A, NULL, b, x, &o);
    CHECK(!r.converged && r.status == SPARSE_STAGNATED && r.iterations <= 22);
    CHECK_CLOSE(r.residual, 1.0, 1e-14);
    sparse_free(&A);
}

/* ---- what cannot be solved --------------------------------------------- */

static int all_finite(int n, const double *x)
{
    for (int i = 0; i < n; ++i)
        if (!(fabs(x[i]) <= DBL_MAX)) return 0;
    return 1;
}

/* Both solvers must refuse, leave a finite x and tell its residual. */
static void check_refusal(const dense *D, const double *b, double least_residual)
{
    static const solver solve[] = {sparse_gmres, sparse_bicgstab};
    sparse A = from_dense(D);
    for (int restart = 0; restart <= 5; restart += 5)
        for (int s = 0; s < 2; ++s) {
            double x[MOST] = {0.0};
            sparse_options o = sparse_defaults();
            o.restart = restart;
            const sparse_result r = solve[s](&A, NULL, b, x, &o);
            CHECK(!r.converged && r.status != SPARSE_CONVERGED);
            CHECK(all_finite(D->n, x));
            CHECK_RELATIVE(r.residual, dense_residual(D, x, b), 1e-9);
            CHECK(r.residual >= least_residual * (1.0 - 1e-12));
            if (s == 0 && restart > 0) CHECK_CLOSE(r.residual, least_residual, 1e-6); /* in these examples GMRES still finds the least there is */
        }
    sparse_free(&A);
}

static void test_singular(void)
{
    double b[MOST], x[MOST];
    dense D = tridiagonal(20, -1.0, 2.0, -1.0);
    D.a[0][0] = D.a[19][19] = 1.0;
    for (int i = 0; i < 20; ++i) b[i] = 1.0 + (i % 2 ? 2.0 : -2.0); /* its mean, 1, is out of reach: |1| / |b| is left */
    check_refusal(&D, b, 1.0 / sqrt(5.0));

    for (int i = 0; i < 20; ++i) b[i] -= 1.0; /* and without the mean there is a solution */
    sparse A = from_dense(&D);
    sparse_options o = sparse_defaults();
    memset(x, 0, sizeof x);
    sparse_result r = sparse_gmres(&A, NULL, b, x, &o);
    CHECK(r.converged && dense_residual(&D, x, b) <= 1e-10);
    sparse_free(&A);

    D = tridiagonal(9, -1.0, 2.5, -1.0); /* a row without entries */
    memset(D.a[4], 0, sizeof D.a[4]);
    for (int i = 0; i < 9; ++i) b[i] = 1.0;
    check_refusal(&D, b, 1.0 / 3.0);

    D = zero_dense(3); /* nothing at all */
    check_refusal(&D, b, 1.0);
    D = zero_dense(1);
    check_refusal(&D, b, 1.0);
}

static void test_failures(void)
{
    const dense D = tridiagonal(50, -1.0, 2.0, -1.0);
    double b[MOST], x[MOST];
    sparse A = from_dense(&D);
    sparse_options o = sparse_defaults();
    for (int i = 0; i < 50; ++i) b[i] = 1.0;

    static const solver solve[] = {sparse_gmres, sparse_bicgstab};
    for (int s = 0; s < 2; ++s) {
        o = sparse_defaults();
        o.max_iterations = 8;
        memset(x, 0, sizeof x);
        sparse_result r = solve[s](&A, NULL, b, x, &o);
        CHECK(!r.converged && r.status == SPARSE_TOO_FEW_ITERATIONS && r.iterations == 8);
        CHECK(r.residual > 1e-3 && strstr(sparse_status_text(r.status), "not converged") != NULL);
        CHECK_RELATIVE(r.residual, dense_residual(&D, x, b), 1e-12);

        o.max_iterations = 0;
        r = solve[s](&A, NULL, b, x, &o);
        CHECK(!r.converged && r.iterations == 0);
        CHECK_RELATIVE(r.residual, dense_residual(&D, x, b), 1e-12);

        o = sparse_defaults(); /* more than double precision can give */
        o.tolerance = 0.0;
        memset(x, 0, sizeof x);
        r = solve[s](&A, NULL, b, x, &o);
        CHECK(!r.converged && r.status != SPARSE_CONVERGED && r.residual < 1e-12);

        /* b = 0 whatever the first guess */
        o = sparse_defaults();
        double zero[MOST] = {0.0};
        x[3] = 1.0;
        r = solve[s](&A, NULL, zero, x, &o);
        CHECK(r.converged && r.iterations == 0 && r.residual == 0.0 && x[3] == 0.0);

        /* sizes whose squares are 0 or infinite */
        for (int large = 0; large < 2; ++large) {
            const double scale = large ? 1e200 : 1e-200;
            double c[MOST];
            for (int i = 0; i < 50; ++i) c[i] = scale * b[i];
            memset(x, 0, sizeof x);
            r = solve[s](&A, NULL, c, x, &o);
            CHECK(r.converged || s == 1);                                /* BiCGStab multiplies residuals with each other, and may give up; */
            CHECK(r.converged || r.residual > o.tolerance);              /* but not lie */
            if (r.converged) CHECK_RELATIVE(x[25], scale * 325.0, 1e-6); /* x_i = (i + 1)(50 - i) / 2 */
        }

        /* what is not a number */
        b[7] = (double)NAN;
        r = solve[s](&A, NULL, b, x, &o);
        CHECK(!r.converged && r.status == SPARSE_NOT_FINITE && r.residual == 1.0 && all_finite(50, x));
        b[7] = 1.0;
        x[7] = (double)INFINITY;
        r = solve[s](&A, NULL, b, x, &o);
        CHECK(!r.converged && r.status == SPARSE_NOT_FINITE && r.residual == 1.0 && all_finite(50, x));
        const double kept[2] = {A.value[4], A.value[5]};
        A.value[5] = (double)NAN;
        x[1] = (double)NAN;
        r = solve[s](&A, NULL, b, x, &o);
        CHECK(!r.converged && r.status == SPARSE_BAD_MATRIX && all_finite(50, x));
        A.value[5] = 1e308; /* overflows on the way */
        A.value[4] = 1e308;
        x[1] = x[2] = 1e10;
        r = solve[s](&A, NULL, b, x, &o);
        CHECK(!r.converged && r.status == SPARSE_NOT_FINITE && r.residual == 1.0 && all_finite(50, x));
        A.value[4] = kept[0];
        A.value[5] = kept[1];
        for (int i = 0; i < 50; ++i) x[i] = 0.0;
        r = solve[s](&A, NULL, b, x, &o);
        CHECK(r.converged); /* the matrix is whole again */
    }
    sparse_free(&A);

    const dense turn = {2, {{0.0, 1.0}, {-1.0, 0.0}}}; /* r . A r = 0: BiCGStab divides by 0, GMRES does not mind */
    A = from_dense(&turn);
    o = sparse_defaults();
    b[0] = b[1] = 1.0;
    x[0] = x[1] = 0.0;
    sparse_result r = sparse_bicgstab(&A, NULL, b, x, &o);
    CHECK(!r.converged && r.status == SPARSE_BREAKDOWN && all_finite(2, x));
    x[0] = x[1] = 0.0;
    r = sparse_gmres(&A, NULL, b, x, &o);
    CHECK(r.converged && fabs(x[0] + 1.0) < 1e-14 && fabs(x[1] - 1.0) < 1e-14);
    sparse_free(&A);
}

/* ILU(0) of a matrix that is far from diagonally dominant may do more harm than good, and BiCGStab run away with it: it must go back to where it began. */
static void test_running_away(void)
{
    pcg32 g;
    pcg32_seed(&g, 10, 1);
    int refused = 0;
    for (int trial = 0; trial < 30; ++trial) {
        const dense D = random_dense(40, 0.3, 0.0, &g);
        double b[MOST], x[MOST] = {0.0};
        sparse A = from_dense(&D);
        sparse_preconditioner P;
        sparse_options o = sparse_defaults();
        o.max_iterations = 100000;
        random_vector(40, b, &g);
        CHECK(sparse_preconditioner_make(&P, SPARSE_ILU0, &A) == 0);
        const sparse_result r = sparse_bicgstab(&A, &P, b, x, &o);
        CHECK(all_finite(40, x) && r.residual <= 1.0);
        CHECK_CLOSE(r.residual, dense_residual(&D, x, b), 1e-9);
        refused += !r.converged;
        sparse_preconditioner_free(&P);
        sparse_free(&A);
    }
    CHECK(refused > 0); /* or this test would say nothing */
}

/* ---- condition --------------------------------------------------------- */

static double dense_condition(const dense *D)
{
    double norm = 0.0, inverse = 0.0;
    for (int j = 0; j < D->n; ++j) {
        double e[MOST], x[MOST], sum = 0.0, inverse_sum = 0.0;
        for (int i = 0; i < D->n; ++i) e[i] = i == j;
        if (!dense_solve(*D, e, x)) return HUGE_VAL;
        for (int i = 0; i < D->n; ++i) {
            sum += fabs(D->a[i][j]);
            inverse_sum += fabs(x[i]);
        }
        norm = fmax(norm, sum);
        inverse = fmax(inverse, inverse_sum);
    }
    return norm * inverse;
}

static void test_condition(void)
{
    static const int size[] = {1, 2, 5, 20, MOST};
    pcg32 g;
    pcg32_seed(&g, 8, 1);
    sparse_options o = sparse_defaults();
    o.tolerance = 1e-8;
    o.restart = 0;
    for (int s = 0; s < 5; ++s)
        for (int form = 0; form < 4; ++form) {
            dense D = form == 0 ? tridiagonal(size[s], -1.0, 2.0, -1.0) : random_dense(size[s], 0.4, form == 1 ? 1.5 : 0.0, &g);
            if (form == 3) /* badly scaled: condition 1e6 and more */
                for (int i = 0; i < size[s]; ++i)
                    for (int j = 0; j < size[s]; ++j) D.a[i][j] *= pow(10.0, 6.0 * i / size[s]);
            sparse A = from_dense(&D);
            const sparse_condition c = sparse_condition_estimate(&A, &o);
            const double exact = dense_condition(&D);
            CHECK(c.converged && c.solves >= 2 && c.iterations >= 2);
            CHECK(c.condition <= exact * (1.0 + 1e-4) && c.condition >= exact / 3.0);
            CHECK_RELATIVE(c.norm * c.inverse_norm, c.condition, 1e-15);
            sparse_free(&A);
        }

    dense D = tridiagonal(20, -1.0, 2.0, -1.0);
    D.a[0][0] = D.a[19][19] = 1.0; /* singular */
    sparse A = from_dense(&D);
    sparse_condition c = sparse_condition_estimate(&A, &o);
    CHECK(!c.converged && c.condition == HUGE_VAL);
    A.value[0] = (double)NAN;
    c = sparse_condition_estimate(&A, &o);
    CHECK(!c.converged && c.condition == HUGE_VAL);
    sparse_free(&A);
    D = tridiagonal(30, -1.0, 2.0, -1.0);
    A = from_dense(&D);
    o.max_iterations = 0;
    c = sparse_condition_estimate(&A, &o);
    CHECK(!c.converged && c.condition == HUGE_VAL);
    sparse_free(&A);
}

/* ---- PETSc ------------------------------------------------------------- */

#if HAVE_PETSC
static void test_petsc(void)
{
    pcg32 g;
    pcg32_seed(&g, 9, 1);
    for (int n = 1; n <= MOST; n = 2 * n + 1) {
        const dense D = tridiagonal(n, -1.3, 2.1, -0.7), any = random_dense(n, 0.3, 1.5, &g);
        compare_with_dense(&D, sparse_petsc, 0, SPARSE_NONE, 1e-8, &g);
        compare_with_dense(&D, sparse_petsc, 20, SPARSE_NONE, 1e-8, &g);
        compare_with_dense(&any, sparse_petsc, 0, SPARSE_NONE, 1e-8, &g);
    }

    /* a first guess far off, and one that is the solution; what is recorded; too few iterations */
    const dense D = random_dense(60, 0.3, 1.1, &g);
    double b[MOST], x[MOST], history[1001];
    sparse A = from_dense(&D);
    sparse_options o = sparse_defaults();
    o.history = history;
    random_vector(60, b, &g);
    int ranks;
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
    /* from 1e6 the residual falls by 17 digits, which takes a restart; PETSc makes it with the sums of one rank only */
    for (int i = 0; i < 60; ++i) x[i] = ranks > 1 ? 1e3 : 1e6;
    const double far = dense_residual(&D, x, b);
    sparse_result r = sparse_petsc(&A, NULL, b, x, &o);
    CHECK(r.converged && r.residual <= 1e-10);
    CHECK_RELATIVE(history[0], far, 1e-9);
    CHECK(history[r.iterations] == r.residual);
    r = sparse_petsc(&A, NULL, b, x, &o);
    CHECK(r.converged && r.iterations == 0);
    o.max_iterations = 2;
    memset(x, 0, sizeof x);
    r = sparse_petsc(&A, NULL, b, x, &o);
    CHECK(!r.converged && r.status == SPARSE_TOO_FEW_ITERATIONS && r.iterations == 2);
    CHECK_RELATIVE(r.residual, dense_residual(&D, x, b), 1e-9);
    b[7] = (double)NAN;
    r = sparse_petsc(&A, NULL, b, x, &o);
    CHECK(!r.converged && r.status == SPARSE_NOT_FINITE && all_finite(60, x));
    sparse_free(&A);
}
#endif

int main(int argc, char **argv)
{
    (void)argc;
    (void)argv;
    test_matrix();
    test_builder_errors();
    test_scaling();
    test_ilu0_exact();
    test_ilu0_on_pattern();
    test_zero_pivots();
    test_solutions();
    test_history();
    test_history_bicgstab();
    test_cyclic_shift();
    test_singular();
    test_failures();
    test_running_away();
    test_condition();
#if HAVE_PETSC
    if (PetscInitialize(&argc, &argv, NULL, NULL) != 0) return 2;
    if (sparse_petsc_helped()) return PetscFinalize() != 0; /* by mpirun: the other ranks */
    test_petsc();
    sparse_petsc_done();
    PetscFinalize();
#endif
    return check_report("test_sparse");
}
