/* SPDX-License-Identifier: MIT */
/*
 * sparse.h - solve A x = b for a sparse, nonsymmetric matrix: compressed rows (CSR), Jacobi and ILU(0), GMRES and BiCGStab, in double precision.
 *
 *     sparse_builder build;
 *     sparse A;
 *     sparse_begin(&build, n, 9 * n);                 room for as many entries at first; more is made as needed
 *     for each row i = 0 ... n-1:
 *         sparse_put(&build, j, value);               any order; entries of equal column add up
 *         sparse_end_row(&build);
 *     if (sparse_finish(&build, &A) != 0) ...         what went wrong on the way is told here
 *
 *     sparse_preconditioner P;
 *     if (sparse_preconditioner_make(&P, SPARSE_ILU0, &A) != 0) ...
 *     sparse_options o = sparse_defaults();
 *     sparse_result r = sparse_gmres(&A, &P, b, x, &o);         x: in the first guess, out the solution
 *     if (!r.converged) ... sparse_status_text(r.status) ...
 *     sparse_preconditioner_free(&P);
 *     sparse_free(&A);
 *
 * Preconditioning is from the right, A M^-1 (M x) = b, so that the residual which the solvers minimise and record is that of the system itself and not of a
 * preconditioned one: histories with different preconditioners can be compared. `converged` means that |b - A x| <= tolerance |b| (2-norm) for the x that is
 * returned, computed from it at the end. A solver that does not get there says why. x never holds a NaN or an infinity on return.
 *
 * Sources: Y. Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., SIAM 2003 (algorithms 10.4 ILU(0), 9.5 GMRES with right preconditioning);
 * Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856 (GMRES); H. A. van der Vorst, SIAM J. Sci. Stat. Comput. 13 (1992) 631 (BiCGStab);
 * N. J. Higham, ACM Trans. Math. Softw. 14 (1988) 381 (the estimate of the condition number).
 */
#ifndef SPARSE_H
#define SPARSE_H

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* ---- the matrix -------------------------------------------------------- */

/* Row i holds the entries start[i] <= k < start[i + 1], in columns index[k], ascending. */
typedef struct sparse {
    int n; /* rows and columns */
    int64_t *start;
    int *index;
    double *value;
} sparse;

static inline void sparse_free(sparse *A)
{
    free(A->start);
    free(A->index);
    free(A->value);
    memset(A, 0, sizeof *A);
}

/* Memory for count items; NULL if there is none, or if size_t cannot say how much. */
static inline void *sparse_memory(int64_t count, size_t item)
{
    const size_t least = count > 0 ? (size_t)count : 1;
    return count < 0 || (uint64_t)count > SIZE_MAX / item ? NULL : malloc(least * item);
}

static inline double *sparse_vector(int n) { return (double *)sparse_memory(n, sizeof(double)); }

typedef struct sparse_builder {
    sparse A;
    int row;          /* the one that is being filled */
    int64_t capacity; /* entries that there is room for */
    int no_memory, bad_entry /* a row or column that is not in the matrix */;
} sparse_builder;

static inline void sparse_begin(sparse_builder *build, int n, int64_t capacity)
{
    memset(build, 0, sizeof *build);
    build->A.n = n;
    build->capacity = capacity > 16 ? capacity : 16;
    build->A.start = (int64_t *)sparse_memory((int64_t)n + 1, sizeof *build->A.start);
    build->A.index = (int *)sparse_memory(build->capacity, sizeof *build->A.index);
    build->A.value = (double *)sparse_memory(build->capacity, sizeof *build->A.value);
    build->bad_entry = n < 1;
    build->no_memory = !build->A.start || !build->A.index || !build->A.value;
    if (!build->no_memory && n >= 1) build->A.start[0] = build->A.start[1] = 0;
}

/* Make room for twice as many entries. */
static inline void sparse_grow(sparse_builder *build)
{
    const int64_t capacity = 2 * build->capacity;
    if (capacity < 0 || (uint64_t)capacity > SIZE_MAX / sizeof(double)) {
        build->no_memory = 1;
        return;
    }
    int *index = (int *)realloc(build->A.index, (size_t)capacity * sizeof *index);
    if (index) build->A.index = index;
    double *value = (double *)realloc(build->A.value, (size_t)capacity * sizeof *value);
    if (value) build->A.value = value;
    build->no_memory = !index || !value;
    if (!build->no_memory) build->capacity = capacity;
}

/* Add an entry to the current row. */
static inline void sparse_put(sparse_builder *build, int column, double value)
{
    if (build->no_memory || build->bad_entry) return;
    if (column < 0 || column >= build->A.n || build->row >= build->A.n) {
        build->bad_entry = 1;
        return;
    }
    int64_t *end = &build->A.start[build->row + 1];
    if (*end == build->capacity) sparse_grow(build);
    if (build->no_memory) return;
    build->A.index[*end] = column;
    build->A.value[*end] = value;
    ++*end;
}

/* Sort the current row by insertion (rows are short and often sorted), add up equal columns, go on to the next row. */
static inline void sparse_end_row(sparse_builder *build)
{
    if (build->no_memory || build->bad_entry) return;
    if (build->row >= build->A.n) {
        build->bad_entry = 1;
        return;
    }
    const int64_t first = build->A.start[build->row], end = build->A.start[build->row + 1];
    int *index = build->A.index;
    double *value = build->A.value;
    int64_t used = first;
    for (int64_t k = first; k < end; ++k) {
        const int column = index[k];
        const double entry = value[k];
        int64_t place = used;
        while (place > first && index[place - 1] > column) --place;
        if (place > first && index[place - 1] == column) {
            value[place - 1] += entry;
            continue;
        }
        memmove(index + place + 1, index + place, (size_t)(used - place) * sizeof *index);
        memmove(value + place + 1, value + place, (size_t)(used - place) * sizeof *value);
        index[place] = column;
        value[place] = entry;
        ++used;
    }
    build->A.start[build->row + 1] = used;
    ++build->row;
    if (build->row < build->A.n) build->A.start[build->row + 1] = used;
}

/* Hand over the matrix, which the caller frees. Returns 0, -1 without memory, -2 for an entry outside the matrix or a number of rows that is not n;
 * then *A is empty. */
static inline int sparse_finish(sparse_builder *build, sparse *A)
{
    const int answer = build->no_memory ? -1 : build->bad_entry || build->row != build->A.n ? -2 : 0;
    *A = build->A;
    if (answer != 0) sparse_free(A);
    memset(build, 0, sizeof *build);
    return answer;
}

/* 0 if the matrix is one (n >= 1, columns in range and ascending, values finite), else 1 + the first row that is not right. */
static inline int sparse_check(const sparse *A)
{
    if (A->n < 1 || !A->start || !A->index || !A->value || A->start[0] != 0) return 1;
    for (int i = 0; i < A->n; ++i) {
        int previous = -1;
        if (A->start[i + 1] < A->start[i]) return 1 + i;
        for (int64_t k = A->start[i]; k < A->start[i + 1]; ++k) {
            if (A->index[k] <= previous || A->index[k] >= A->n || !(fabs(A->value[k]) <= DBL_MAX)) return 1 + i;
            previous = A->index[k];
        }
    }
    return 0;
}

/* sum value[k] x[index[k]]: in four sums, because the processor can add while it waits for other sums, and the compiler may not reorder one. */
static inline double sparse_row_dot(const double *restrict value, const int *restrict index, int64_t count, const double *restrict x)
{
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    int64_t k = 0;
    for (; k < count - 3; k += 4) {
        s0 += value[k] * x[index[k]];
        s1 += value[k + 1] * x[index[k + 1]];
        s2 += value[k + 2] * x[index[k + 2]];
        s3 += value[k + 3] * x[index[k + 3]];
    }
    for (; k < count; ++k) s0 += value[k] * x[index[k]];
    return (s0 + s1) + (s2 + s3);
}

/* y = A x; y is not x */
static inline void sparse_multiply(const sparse *A, const double *restrict x, double *restrict y)
{
    for (int i = 0; i < A->n; ++i) {
        const int64_t first = A->start[i];
        y[i] = sparse_row_dot(A->value + first, A->index + first, A->start[i + 1] - first, x);
    }
}

/* r = b - A x; r may be b, not x */
static inline void sparse_residual(const sparse *A, const double *b, const double *x, double *r)
{
    for (int i = 0; i < A->n; ++i) {
        const int64_t first = A->start[i];
        r[i] = b[i] - sparse_row_dot(A->value + first, A->index + first, A->start[i + 1] - first, x);
    }
}

/* T = A^T, which the caller frees. Returns 0, or -1 without memory. */
static inline int sparse_transpose(const sparse *A, sparse *T)
{
    const int64_t count = A->start[A->n];
    T->n = A->n;
    T->start = (int64_t *)sparse_memory((int64_t)A->n + 1, sizeof *T->start);
    T->index = (int *)sparse_memory(count, sizeof *T->index);
    T->value = (double *)sparse_memory(count, sizeof *T->value);
    if (!T->start || !T->index || !T->value) {
        sparse_free(T);
        return -1;
    }
    memset(T->start, 0, ((size_t)A->n + 1) * sizeof *T->start);
    for (int64_t k = 0; k < count; ++k) ++T->start[A->index[k] + 1];
    for (int j = 0; j < A->n; ++j) T->start[j + 1] += T->start[j];
    for (int i = 0; i < A->n; ++i) /* rows in ascending order make ascending columns; start[j] runs to the end of row j ... */
        for (int64_t k = A->start[i]; k < A->start[i + 1]; ++k) {
            const int64_t place = T->start[A->index[k]]++;
            T->index[place] = i;
            T->value[place] = A->value[k];
        }
    for (int j = A->n; j > 0; --j) T->start[j] = T->start[j - 1]; /* ... and goes back to its beginning */
    T->start[0] = 0;
    return 0;
}

/* Where the diagonal of row i is stored; -1 if it is not. */
static inline int64_t sparse_diagonal(const sparse *A, int i)
{
    int64_t low = A->start[i], high = A->start[i + 1];
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (A->index[middle] < i) low = middle + 1;
        else high = middle;
    }
    return low < A->start[i + 1] && A->index[low] == i ? low : -1;
}

/* Divide every row, and b unless NULL, by its diagonal. Returns 0, or 1 + the first row whose diagonal is missing or 0, or whose quotients are not finite; then
 * nothing has changed. */
static inline int sparse_scale_rows(sparse *A, double *b)
{
    for (int i = 0; i < A->n; ++i) {
        const int64_t d = sparse_diagonal(A, i);
        if (d < 0 || (b && !(fabs(b[i] / A->value[d]) <= DBL_MAX))) return 1 + i;
        for (int64_t k = A->start[i]; k < A->start[i + 1]; ++k)
            if (!(fabs(A->value[k] / A->value[d]) <= DBL_MAX)) return 1 + i;
    }
    for (int i = 0; i < A->n; ++i) {
        const double diagonal = A->value[sparse_diagonal(A, i)];
        for (int64_t k = A->start[i]; k < A->start[i + 1]; ++k) A->value[k] /= diagonal;
        if (b) b[i] /= diagonal;
    }
    return 0;
}

/* max over the columns of the sum of |a_ij|; -1 without memory */
static inline double sparse_norm1(const sparse *A)
{
    double largest = 0.0, *sum = sparse_vector(A->n);
    if (!sum) return -1.0;
    for (int j = 0; j < A->n; ++j) sum[j] = 0.0;
    for (int64_t k = 0; k < A->start[A->n]; ++k) sum[A->index[k]] += fabs(A->value[k]);
    for (int j = 0; j < A->n; ++j) largest = sum[j] > largest ? sum[j] : largest;
    free(sum);
    return largest;
}

/* ---- vectors ----------------------------------------------------------- */

static inline double sparse_dot(int n, const double *restrict x, const double *restrict y)
{
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    int i = 0;
    for (; i < n - 3; i += 4) {
        s0 += x[i] * y[i];
        s1 += x[i + 1] * y[i + 1];
        s2 += x[i + 2] * y[i + 2];
        s3 += x[i + 3] * y[i + 3];
    }
    for (; i < n; ++i) s0 += x[i] * y[i];
    return (s0 + s1) + (s2 + s3);
}

/* |x|, also where the squares overflow or vanish. */
static inline double sparse_norm(int n, const double *x)
{
    const double square = sparse_dot(n, x, x);
    if (square > 1e-250 && square < 1e250) return sqrt(square);
    double largest = 0.0, sum = 0.0;
    for (int i = 0; i < n; ++i) largest = fabs(x[i]) > largest ? fabs(x[i]) : largest;
    if (largest == 0.0) return sqrt(square); /* all 0 or NaN */
    for (int i = 0; i < n; ++i) sum += (x[i] / largest) * (x[i] / largest);
    return largest * sqrt(sum);
}

/* y += a x */
static inline void sparse_axpy(int n, double a, const double *restrict x, double *restrict y)
{
    for (int i = 0; i < n; ++i) y[i] += a * x[i];
}

/* ---- preconditioners --------------------------------------------------- */

typedef enum sparse_method {
    SPARSE_NONE,
    SPARSE_JACOBI, /* M = the diagonal of A */
    SPARSE_ILU0    /* M = L U with entries where A has entries, and L U = A there */
} sparse_method;

typedef struct sparse_preconditioner {
    sparse_method method;
    const sparse *A;   /* ILU(0) has its pattern: it must outlive the preconditioner, its values may change */
    double *inverse;   /* of the diagonal of A (Jacobi) or of U (ILU0) */
    double *factor;    /* ILU(0): L without its unit diagonal, and U */
    int64_t *diagonal; /* where the diagonal is stored */
} sparse_preconditioner;

static inline void sparse_preconditioner_free(sparse_preconditioner *P)
{
    free(P->inverse);
    free(P->factor);
    free(P->diagonal);
    memset(P, 0, sizeof *P);
}

/* Row i of ILU(0), given the rows above: place[j] says where this row stores column j, and is -1 where it does not. */
static inline void sparse_ilu0_row(const sparse_preconditioner *P, int i, const int64_t *place)
{
    const sparse *A = P->A;
    double *f = P->factor;
    for (int64_t k = A->start[i]; k < P->diagonal[i]; ++k) {
        const int row = A->index[k];
        const double l = f[k] *= P->inverse[row];
        for (int64_t m = P->diagonal[row] + 1; m < A->start[row + 1]; ++m) {
            const int64_t at = place[A->index[m]];
            if (at >= 0) f[at] -= l * f[m];
        }
    }
}

/* Saad's algorithm 10.4 (IKJ). Returns 0, -1 without memory, or 1 + the row whose pivot is no more than rounding errors of the row, or not finite: dividing by
 * it would make a preconditioner of noise. */
static inline int sparse_ilu0(sparse_preconditioner *P)
{
    const sparse *A = P->A;
    const int64_t count = A->start[A->n];
    int64_t *place = (int64_t *)sparse_memory(A->n, sizeof *place);
    P->factor = (double *)sparse_memory(count, sizeof *P->factor);
    if (!place || !P->factor) {
        free(place);
        return -1;
    }
    memcpy(P->factor, A->value, (size_t)count * sizeof *P->factor);
    for (int j = 0; j < A->n; ++j) place[j] = -1;

    int bad = 0;
    for (int i = 0; i < A->n && !bad; ++i) {
        double largest = 0.0;
        for (int64_t k = A->start[i]; k < A->start[i + 1]; ++k) {
            place[A->index[k]] = k;
            largest = fabs(A->value[k]) > largest ? fabs(A->value[k]) : largest;
        }
        sparse_ilu0_row(P, i, place);
        for (int64_t k = A->start[i]; k < A->start[i + 1]; ++k) place[A->index[k]] = -1;
        const double pivot = P->factor[P->diagonal[i]];
        P->inverse[i] = 1.0 / pivot;
        if (!(fabs(pivot) > DBL_EPSILON * largest && fabs(pivot) <= DBL_MAX && fabs(P->inverse[i]) <= DBL_MAX)) bad = 1 + i;
    }
    free(place);
    return bad;
}

/* Returns 0, -1 without memory, -2 for a matrix that sparse_check refuses, or 1 + the first row whose diagonal is missing or whose pivot is 0; after a failure
 * the preconditioner does nothing (SPARSE_NONE) and holds no memory. */
static inline int sparse_preconditioner_make(sparse_preconditioner *P, sparse_method method, const sparse *A)
{
    int answer = sparse_check(A) == 0 ? 0 : -2;
    memset(P, 0, sizeof *P);
    P->A = A;
    P->method = method;
    if (answer != 0 || method == SPARSE_NONE) {
        P->method = SPARSE_NONE;
        return answer;
    }
    P->inverse = sparse_vector(A->n);
    P->diagonal = (int64_t *)sparse_memory(A->n, sizeof *P->diagonal);
    if (!P->inverse || !P->diagonal) answer = -1;
    for (int i = 0; i < A->n && answer == 0; ++i) {
        P->diagonal[i] = sparse_diagonal(A, i);
        if (P->diagonal[i] < 0) answer = 1 + i;
        else P->inverse[i] = 1.0 / A->value[P->diagonal[i]];
        if (answer == 0 && method == SPARSE_JACOBI && !(fabs(P->inverse[i]) <= DBL_MAX)) answer = 1 + i;
    }
    if (answer == 0 && method == SPARSE_ILU0) answer = sparse_ilu0(P);
    if (answer != 0) sparse_preconditioner_free(P);
    return answer;
}

/* What the answers of sparse_finish, sparse_transpose, sparse_scale_rows and sparse_preconditioner_make mean. */
static inline const char *sparse_answer_text(int answer)
{
    return answer == 0 ? "done" : answer == -1 ? "not enough memory" : answer == -2 ? "not a valid matrix" : "a diagonal is missing, or a pivot is 0";
}

/* z = M^-1 r; z is not r. P may be NULL: M = 1. */
static inline void sparse_precondition(const sparse_preconditioner *P, int n, const double *restrict r, double *restrict z)
{
    if (!P || P->method == SPARSE_NONE) {
        memcpy(z, r, (size_t)n * sizeof *z);
    } else if (P->method == SPARSE_JACOBI) {
        for (int i = 0; i < n; ++i) z[i] = P->inverse[i] * r[i];
    } else {
        const int64_t *start = P->A->start, *diagonal = P->diagonal;
        const int *index = P->A->index;
        for (int i = 0; i < n; ++i) z[i] = r[i] - sparse_row_dot(P->factor + start[i], index + start[i], diagonal[i] - start[i], z);
        for (int i = n - 1; i >= 0; --i) {
            const int64_t right = diagonal[i] + 1;
            z[i] = P->inverse[i] * (z[i] - sparse_row_dot(P->factor + right, index + right, start[i + 1] - right, z));
        }
    }
}

/* ---- what the solvers share -------------------------------------------- */

typedef enum sparse_status {
    SPARSE_CONVERGED,
    SPARSE_TOO_FEW_ITERATIONS, /* max_iterations are used up */
    SPARSE_STAGNATED,          /* a restart brought nothing: singular matrix, tolerance below rounding, or restart too short */
    SPARSE_BREAKDOWN,          /* BiCGStab divides by 0 or runs away, also after a restart */
    SPARSE_NOT_FINITE,         /* the matrix, b, the first guess or what came of them overflow or are NaN */
    SPARSE_BAD_MATRIX,         /* sparse_check refuses it */
    SPARSE_NO_MEMORY,
    SPARSE_FAILED /* another package's solver gave up */
} sparse_status;

static inline const char *sparse_status_text(sparse_status status)
{
    static const char *const text[] = {"converged",
                                       "not converged: the iterations are used up",
                                       "not converged: no progress",
                                       "not converged: breakdown",
                                       "not converged: overflow or NaN",
                                       "not a valid matrix",
                                       "not enough memory",
                                       "not converged: the solver gave up"};
    return (int)status >= 0 && status <= SPARSE_FAILED ? text[status] : "unknown status";
}

typedef struct sparse_options {
    double tolerance;   /* of |b - A x| / |b| */
    int max_iterations; /* over all restarts */
    int restart;        /* GMRES: vectors in a cycle; 0: full GMRES, which keeps one vector of n doubles for each iteration */
    double *history;    /* NULL, or max_iterations + 1 places: |b - A x| / |b| after each iteration, from that of the first guess on */
    void (*monitor)(void *context, int iteration, double residual); /* NULL, or called after each iteration */
    void *context;
} sparse_options;

static inline sparse_options sparse_defaults(void)
{
    sparse_options o;
    memset(&o, 0, sizeof o);
    o.tolerance = 1e-10;
    o.max_iterations = 1000;
    o.restart = 50;
    return o;
}

typedef struct sparse_result {
    int converged;   /* |b - A x| <= tolerance |b|, verified with the x that is returned */
    int iterations;  /* multiplications by A: one for each iteration of GMRES, two of BiCGStab, not counting those that verify */
    double residual; /* |b - A x| / |b| of the x that is returned; 0 for b = 0 (then x = 0) */
    sparse_status status;
} sparse_result;

static inline void sparse_record(const sparse_options *o, int iteration, double residual)
{
    if (o->history) o->history[iteration] = residual;
    if (o->monitor) o->monitor(o->context, iteration, residual);
}

/* What all solvers do first. Returns 1 if there is something to solve, with |b|; otherwise *result is the answer. */
static inline int sparse_solve_begin(const sparse *A, const double *b, double *x, const sparse_options *o, sparse_result *result, double *b_norm)
{
    memset(result, 0, sizeof *result);
    result->residual = 1.0; /* of x = 0 */
    result->status = sparse_check(A) != 0 ? SPARSE_BAD_MATRIX : SPARSE_TOO_FEW_ITERATIONS;
    *b_norm = 0.0;
    if (result->status == SPARSE_BAD_MATRIX) {
        for (int i = 0; i < A->n; ++i) x[i] = 0.0;
        return 0;
    }
    *b_norm = sparse_norm(A->n, b);
    if (!(*b_norm <= DBL_MAX) || !(sparse_norm(A->n, x) <= DBL_MAX)) {
        memset(x, 0, (size_t)A->n * sizeof *x);
        result->status = SPARSE_NOT_FINITE;
        return 0;
    }
    if (*b_norm == 0.0) {
        memset(x, 0, (size_t)A->n * sizeof *x);
        result->residual = 0.0;
        result->converged = 1;
        result->status = SPARSE_CONVERGED;
        sparse_record(o, 0, 0.0);
        return 0;
    }
    return 1;
}

/* What all solvers do last: an x that is not finite becomes 0, and the residual is computed from x. r: n places. */
static inline void sparse_solve_end(const sparse *A, const double *b, double *x, double *r, const sparse_options *o, double b_norm, sparse_result *result)
{
    sparse_residual(A, b, x, r);
    result->residual = sparse_norm(A->n, r) / b_norm;
    if (!(result->residual <= DBL_MAX) || !(sparse_norm(A->n, x) <= DBL_MAX)) { /* of a column without entries the residual does not tell */
        memset(x, 0, (size_t)A->n * sizeof *x);
        result->residual = 1.0;
        result->status = SPARSE_NOT_FINITE;
    }
    result->converged = result->residual <= o->tolerance;
    if (result->converged) result->status = SPARSE_CONVERGED;
    else if (result->status == SPARSE_CONVERGED) result->status = SPARSE_STAGNATED;
    if (o->history) o->history[result->iterations] = result->residual;
}

/* ---- GMRES ------------------------------------------------------------- */

typedef struct sparse_krylov {
    int size, made; /* vectors of a cycle, and those for which there is memory: it is taken when first needed */
    double **v;     /* size + 1 orthonormal vectors */
    double **h;     /* column k of the Hessenberg matrix, k + 2 entries, turned to triangular by the rotations */
    double *c, *s, *g, *y;
    double *z;
} sparse_krylov;

static inline void sparse_krylov_free(sparse_krylov *K)
{
    for (int k = 0; K->v && k <= K->size; ++k) free(K->v[k]);
    for (int k = 0; K->h && k < K->size; ++k) free(K->h[k]);
    free(K->v);
    free(K->h);
    free(K->c);
    free(K->z);
    memset(K, 0, sizeof *K);
}

/* Returns 0 without memory. */
static inline int sparse_krylov_open(sparse_krylov *K, int n, int size)
{
    memset(K, 0, sizeof *K);
    K->size = size;
    K->v = (double **)calloc((size_t)size + 1, sizeof *K->v);
    K->h = (double **)calloc((size_t)size + 1, sizeof *K->h);
    K->c = (double *)sparse_memory(4 * (int64_t)size + 4, sizeof *K->c);
    K->z = sparse_vector(n);
    if (!K->v || !K->h || !K->c || !K->z) return 0;
    K->s = K->c + size + 1;
    K->g = K->s + size + 1;
    K->y = K->g + size + 1;
    K->v[0] = sparse_vector(n);
    return K->v[0] != NULL;
}

/* Memory for step k; returns 0 if there is none. */
static inline int sparse_krylov_extend(sparse_krylov *K, int n, int k)
{
    if (k < K->made) return 1;
    K->h[k] = sparse_vector(k + 2);
    K->v[k + 1] = sparse_vector(n);
    K->made = k + 1;
    return K->h[k] && K->v[k + 1];
}

/* One step of Arnoldi with modified Gram-Schmidt, and the Givens rotation that keeps h triangular. Returns 1 if column k can be used, 0 if it depends on those
 * before it, -1 if it is not finite. *last is set if v[k + 1] does not exist, since the space is invariant. */
static inline int sparse_arnoldi(const sparse *A, const sparse_preconditioner *P, sparse_krylov *K, int k, int *last)
{
    const int n = A->n;
    double *h = K->h[k], *w = K->v[k + 1];
    sparse_precondition(P, n, K->v[k], K->z);
    sparse_multiply(A, K->z, w);
    const double size = sparse_norm(n, w), noise = 16.0 * DBL_EPSILON * size;
    if (!(size <= DBL_MAX)) return -1;
    for (int i = 0; i <= k; ++i) {
        h[i] = sparse_dot(n, K->v[i], w);
        sparse_axpy(n, -h[i], K->v[i], w);
    }
    h[k + 1] = sparse_norm(n, w);
    *last = !(h[k + 1] > noise);
    if (*last) h[k + 1] = 0.0;
    for (int i = 0; i < n && !*last; ++i) w[i] /= h[k + 1];

    for (int i = 0; i < k; ++i) {
        const double upper = h[i];
        h[i] = K->c[i] * upper + K->s[i] * h[i + 1];
        h[i + 1] = K->c[i] * h[i + 1] - K->s[i] * upper;
    }
    const double length = hypot(h[k], h[k + 1]);
    if (!(length <= DBL_MAX)) return -1;
    if (!(length > noise)) return 0;
    K->c[k] = h[k] / length;
    K->s[k] = h[k + 1] / length;
    h[k] = length;
    K->g[k + 1] = -K->s[k] * K->g[k];
    K->g[k] *= K->c[k];
    return 1;
}

/* x += M^-1 V y with the y that makes the residual least; V has `count` columns. Returns 0, and leaves x alone, if that is not finite. */
static inline int sparse_gmres_update(const sparse_preconditioner *P, sparse_krylov *K, int n, int count, double *x)
{
    double *w = K->v[count]; /* the one that V does not need any more */
    for (int k = count - 1; k >= 0; --k) {
        double sum = K->g[k];
        for (int i = k + 1; i < count; ++i) sum -= K->h[i][k] * K->y[i];
        K->y[k] = sum / K->h[k][k];
    }
    for (int i = 0; i < n; ++i) w[i] = 0.0;
    for (int k = 0; k < count; ++k) sparse_axpy(n, K->y[k], K->v[k], w);
    sparse_precondition(P, n, w, K->z);
    if (!(sparse_norm(n, K->z) <= DBL_MAX)) return 0;
    sparse_axpy(n, 1.0, K->z, x);
    return 1;
}

/* One cycle from the residual in v[0], of norm beta. Returns SPARSE_CONVERGED if it ran well (converged or not), else what happened; x is finite in any case.
 * */
static inline sparse_status sparse_gmres_cycle(const sparse *A, const sparse_preconditioner *P, sparse_krylov *K, double beta, double *x,
                                               const sparse_options *o, double b_norm, int *iterations)
{
    const int n = A->n;
    sparse_status status = SPARSE_CONVERGED;
    int count = 0, last = 0;
    for (int i = 0; i < n; ++i) K->v[0][i] /= beta;
    K->g[0] = beta;
    while (count < K->size && *iterations < o->max_iterations && !last) {
        if (!sparse_krylov_extend(K, n, count)) {
            status = SPARSE_NO_MEMORY;
            break;
        }
        const int usable = sparse_arnoldi(A, P, K, count, &last);
        ++*iterations;
        if (usable < 0) status = SPARSE_NOT_FINITE;
        if (usable > 0) ++count;
        sparse_record(o, *iterations, fabs(K->g[count]) / b_norm);
        if (usable <= 0 || fabs(K->g[count]) <= o->tolerance * b_norm) break;
    }
    if (count > 0 && !sparse_gmres_update(P, K, n, count, x)) status = SPARSE_NOT_FINITE;
    return status;
}

/* GMRES(restart), right preconditioned; restart = 0 is full GMRES, which starts again only where rounding made its estimate of the residual smaller than the
 * residual. Memory: restart + 3 vectors. P may be NULL. */
static inline sparse_result sparse_gmres(const sparse *A, const sparse_preconditioner *P, const double *b, double *x, const sparse_options *options)
{
    sparse_options o = *options;
    sparse_result result;
    sparse_krylov K;
    double b_norm;
    if (o.max_iterations < 0) o.max_iterations = 0;
    if (!sparse_solve_begin(A, b, x, &o, &result, &b_norm)) return result;

    int size = o.restart > 0 && o.restart < o.max_iterations ? o.restart : o.max_iterations;
    if (size > A->n) size = A->n;
    double *r = sparse_vector(A->n);
    if (!r || !sparse_krylov_open(&K, A->n, size)) {
        if (r) sparse_krylov_free(&K);
        free(r);
        memset(x, 0, (size_t)A->n * sizeof *x); /* whose residual is the 1 that is returned */
        result.status = SPARSE_NO_MEMORY;
        return result;
    }
    double before = HUGE_VAL;
    for (int cycle = 0;; ++cycle) {
        sparse_residual(A, b, x, K.v[0]);
        const double beta = sparse_norm(A->n, K.v[0]);
        if (cycle == 0) sparse_record(&o, 0, beta / b_norm);
        if (beta <= o.tolerance * b_norm) result.status = SPARSE_CONVERGED;
        else if (!(beta <= DBL_MAX)) result.status = SPARSE_NOT_FINITE;
        else if (beta > 0.999999 * before) result.status = SPARSE_STAGNATED; /* at this rate a digit takes 2e6 cycles */
        if (result.status != SPARSE_TOO_FEW_ITERATIONS || result.iterations >= o.max_iterations) break;
        before = beta;
        const sparse_status status = sparse_gmres_cycle(A, P, &K, beta, x, &o, b_norm, &result.iterations);
        if (status != SPARSE_CONVERGED) {
            result.status = status;
            break;
        }
    }
    sparse_solve_end(A, b, x, r, &o, b_norm, &result);
    sparse_krylov_free(&K);
    free(r);
    return result;
}

/* ---- BiCGStab ---------------------------------------------------------- */

/* The vector that BiCGStab takes products with: r plus noise of its size, always the same. With r alone, which is usual, symmetric boundary data and ILU(0)
 * make products of 0 and a breakdown (seen with the mimetic scheme on a square). */
static inline void sparse_shadow(int n, const double *r, double *shadow)
{
    const double size = sparse_norm(n, r) / sqrt((double)n);
    uint32_t state = 1;
    for (int i = 0; i < n; ++i) {
        state = state * 1664525U + 1013904223U;                                      /* Knuth's and Lewis's; the high bits are the good ones */
        shadow[i] = r[i] + size * ((double)(state >> 8) * (2.0 / 16777216.0) - 1.0); /* (-1, 1) */
    }
}

/* Iterate until the residual r that the recurrence carries along is small, from r and x that belong together. v: 6 vectors of which v[0] is r. Returns
 * SPARSE_CONVERGED, SPARSE_BREAKDOWN or SPARSE_TOO_FEW_ITERATIONS. */
static inline sparse_status sparse_bicgstab_run(const sparse *A, const sparse_preconditioner *P, double *const *v, double *x, const sparse_options *o,
                                                double b_norm, int *iterations)
{
    const int n = A->n;
    double *r = v[0], *shadow = v[1], *p = v[2], *Ap = v[3], *z = v[4], *t = v[5];
    double rho = 1.0, alpha = 1.0, omega = 1.0;
    const double most = 1e10 * sparse_norm(n, r); /* what rounding leaves of such a residual is more than that with which it began */
    sparse_shadow(n, r, shadow);
    for (int i = 0; i < n; ++i) p[i] = Ap[i] = 0.0;
    while (*iterations + 2 <= o->max_iterations) {
        const double rho_new = sparse_dot(n, shadow, r), beta = rho_new / rho * (alpha / omega);
        if (!(fabs(beta) <= DBL_MAX) || fabs(rho_new) <= DBL_EPSILON * DBL_EPSILON * sparse_norm(n, shadow) * sparse_norm(n, r)) return SPARSE_BREAKDOWN;
        rho = rho_new;
        for (int i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * Ap[i]);
        sparse_precondition(P, n, p, z);
        sparse_multiply(A, z, Ap);
        alpha = rho / sparse_dot(n, shadow, Ap);
        if (!(fabs(alpha) <= DBL_MAX)) return SPARSE_BREAKDOWN;
        sparse_axpy(n, alpha, z, x);
        sparse_axpy(n, -alpha, Ap, r);
        ++*iterations;
        double size = sparse_norm(n, r);
        sparse_record(o, *iterations, size / b_norm);
        if (!(size <= most)) return SPARSE_BREAKDOWN;
        if (size <= o->tolerance * b_norm) return SPARSE_CONVERGED;

        sparse_precondition(P, n, r, z);
        sparse_multiply(A, z, t);
        ++*iterations;
        omega = sparse_dot(n, t, r) / sparse_dot(n, t, t);
        if (!(fabs(omega) <= DBL_MAX)) omega = 0.0;
        sparse_axpy(n, omega, z, x);
        sparse_axpy(n, -omega, t, r);
        size = sparse_norm(n, r);
        sparse_record(o, *iterations, size / b_norm);
        if (!(size <= most)) return SPARSE_BREAKDOWN;
        if (size <= o->tolerance * b_norm) return SPARSE_CONVERGED;
        if (omega == 0.0) return SPARSE_BREAKDOWN;
    }
    return SPARSE_TOO_FEW_ITERATIONS;
}

/* BiCGStab, right preconditioned: 7 vectors whatever the number of iterations, but the residual may rise on the way. The history counts half steps, so that its
 * abscissa is the number of multiplications, as for GMRES. It starts again from the residual itself after a breakdown, and where the recurrence has lost it. P
 * may be NULL. */
static inline sparse_result sparse_bicgstab(const sparse *A, const sparse_preconditioner *P, const double *b, double *x, const sparse_options *options)
{
    sparse_options o = *options;
    sparse_result result;
    double b_norm, *v[7], before = HUGE_VAL;
    if (!sparse_solve_begin(A, b, x, &o, &result, &b_norm)) return result;

    int missing = 0;
    for (int k = 0; k < 7; ++k) missing += (v[k] = sparse_vector(A->n)) == NULL;
    if (missing) memset(x, 0, (size_t)A->n * sizeof *x); /* whose residual is the 1 that is returned */
    result.status = missing ? SPARSE_NO_MEMORY : SPARSE_CONVERGED;
    for (int cycle = 0; result.status == SPARSE_CONVERGED || result.status == SPARSE_BREAKDOWN; ++cycle) {
        sparse_residual(A, b, x, v[0]);
        const double beta = sparse_norm(A->n, v[0]);
        if (cycle == 0) sparse_record(&o, 0, beta / b_norm);
        if (beta <= o.tolerance * b_norm || (cycle == 0 && !(beta <= DBL_MAX))) break;
        if (cycle > 0 && !(beta < 0.999 * before)) {
            if (!(beta < before)) memcpy(x, v[6], (size_t)A->n * sizeof *x); /* worse than it was: back */
            if (result.status == SPARSE_CONVERGED) result.status = SPARSE_STAGNATED;
            break;
        }
        memcpy(v[6], x, (size_t)A->n * sizeof *x);
        before = beta;
        result.status = sparse_bicgstab_run(A, P, v, x, &o, b_norm, &result.iterations);
    }
    if (!missing) sparse_solve_end(A, b, x, v[6], &o, b_norm, &result);
    for (int k = 0; k < 7; ++k) free(v[k]);
    return result;
}

/* ---- condition number -------------------------------------------------- */

typedef struct sparse_condition {
    int converged;       /* all solves did; if not, condition = HUGE_VAL: nothing is known */
    double norm;         /* |A| in the 1-norm (largest column sum), exact */
    double inverse_norm; /* |A^-1|: a lower bound, seldom less than a third of it */
    double condition;    /* norm * inverse_norm */
    int solves, iterations;
} sparse_condition;

typedef struct sparse_inverse {
    const sparse *A, *T; /* the matrix and its transpose */
    const sparse_preconditioner *P, *P_T;
    const sparse_options *o;
    sparse_condition *answer;
} sparse_inverse;

/* x = A^-1 b, or A^-T b. Returns whether it converged. */
static inline int sparse_inverse_times(const sparse_inverse *S, int transposed, const double *b, double *x)
{
    for (int i = 0; i < S->A->n; ++i) x[i] = 0.0;
    const sparse_result r = sparse_gmres(transposed ? S->T : S->A, transposed ? S->P_T : S->P, b, x, S->o);
    ++S->answer->solves;
    S->answer->iterations += r.iterations;
    return r.converged;
}

static inline double sparse_sum_abs(int n, const double *x)
{
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += fabs(x[i]);
    return sum;
}

/* Higham's algorithm 4.1: climb on the convex function |A^-1 x| over |x| = 1 from corner to corner, then try a vector that the climb is known to be fooled by
 * less. Returns whether all solves converged. x, y, z: n places each */
static inline int sparse_inverse_norm(const sparse_inverse *S, double *x, double *y, double *z)
{
    const int n = S->A->n;
    double estimate = 0.0;
    for (int i = 0; i < n; ++i) x[i] = 1.0 / n;
    for (int step = 0; step < 5; ++step) {
        if (!sparse_inverse_times(S, 0, x, y)) return 0;
        const double size = sparse_sum_abs(n, y);
        const int better = size > estimate;
        if (better) estimate = size;
        if (n == 1 || (step > 0 && !better)) break;
        for (int i = 0; i < n; ++i) y[i] = y[i] < 0.0 ? -1.0 : 1.0;
        if (!sparse_inverse_times(S, 1, y, z)) return 0;
        int steepest = 0;
        for (int i = 1; i < n; ++i)
            if (fabs(z[i]) > fabs(z[steepest])) steepest = i;
        if (step > 0 && fabs(z[steepest]) <= sparse_dot(n, z, x)) break; /* x is a local maximum */
        for (int i = 0; i < n; ++i) x[i] = i == steepest;
    }
    for (int i = 0; i < n; ++i) x[i] = (i % 2 ? -1.0 : 1.0) * (1.0 + (n > 1 ? i / (n - 1.0) : 0.0));
    if (!sparse_inverse_times(S, 0, x, y)) return 0;
    const double other = 2.0 * sparse_sum_abs(n, y) / (3.0 * n);
    S->answer->inverse_norm = other > estimate ? other : estimate;
    return 1;
}

/* The estimate with one preconditioner. T = A^T */
static inline sparse_condition sparse_condition_by(sparse_method method, const sparse *A, const sparse *T, const sparse_options *o)
{
    sparse_condition answer;
    sparse_preconditioner P, P_T;
    memset(&answer, 0, sizeof answer);
    answer.condition = HUGE_VAL;
    answer.norm = sparse_norm1(A);
    double *x = sparse_vector(A->n), *y = sparse_vector(A->n), *z = sparse_vector(A->n);
    const int failed = sparse_preconditioner_make(&P, method, A), failed_T = sparse_preconditioner_make(&P_T, method, T);
    if (x && y && z && answer.norm > 0.0 && !failed && !failed_T) {
        sparse_inverse S;
        S.A = A;
        S.T = T;
        S.P = &P;
        S.P_T = &P_T;
        S.o = o;
        S.answer = &answer;
        answer.converged = sparse_inverse_norm(&S, x, y, z);
        if (answer.converged) answer.condition = answer.norm * answer.inverse_norm;
    }
    free(x);
    free(y);
    free(z);
    sparse_preconditioner_free(&P);
    sparse_preconditioner_free(&P_T);
    return answer;
}

/* Estimate the condition number |A| |A^-1| in the 1-norm with 2 to 11 solves by GMRES with ILU(0), or with Jacobi or nothing if they fail (ILU(0) can do harm
 * far from diagonal dominance). A loose tolerance is enough: a relative residual of 1e-6 changes the estimate by no more than sqrt(n) * 1e-6 of itself. The
 * transpose and two factorisations are held meanwhile. */
static inline sparse_condition sparse_condition_estimate(const sparse *A, const sparse_options *options)
{
    sparse_condition answer;
    sparse_options o = *options;
    sparse T;
    memset(&answer, 0, sizeof answer);
    answer.condition = HUGE_VAL;
    o.history = NULL;
    if (sparse_check(A) != 0 || sparse_transpose(A, &T) != 0) return answer;
    for (int method = SPARSE_ILU0; method >= SPARSE_NONE && !answer.converged; --method) answer = sparse_condition_by((sparse_method)method, A, &T, &o);
    sparse_free(&T);
    return answer;
}

#endif
