/* SPDX-License-Identifier: MIT */
/*
 * banded.h - solve A x = b for a general band matrix by LU with partial
 * pivoting, on memory that the caller owns:
 *
 *     double *memory = malloc(banded_size(n, kl, ku) * sizeof *memory);
 *     banded A = banded_make(memory, n, kl, ku);
 *     banded_zero(&A);
 *     banded_add(&A, i, j, value);           for every i - kl <= j <= i + ku
 *     status = banded_factor_solve(&A, b);   b becomes x, A is used up
 *
 * Rows are stored one after the other, so that taking a multiple of one row
 * from another runs over contiguous memory.  Row i holds the columns i-kl to
 * i+ku+kl: the pivots fill up to kl columns right of the band.  Columns are
 * eliminated BANDED_PANEL at a time (see banded_update), for which every row
 * has BANDED_PANEL-1 more places on either side.
 */
#ifndef BANDED_H
#define BANDED_H

#include <assert.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { BANDED_PANEL = 4 };

typedef struct banded {
    double *a;
    int n;      /* rows and columns */
    int kl, ku; /* diagonals below and above the main one, at most n-1 */
    int width;  /* stored places per row */
} banded;

static inline int banded_min(int a, int b) { return a < b ? a : b; }

/* Stored places per row; 0 if the arguments make no sense or an int is too small. */
static inline int banded_width(int n, int kl, int ku)
{
    if (n < 1 || kl < 0 || ku < 0) return 0;
    kl = banded_min(kl, n - 1);
    ku = banded_min(ku, n - 1);
    const int right = ku < n - 1 - kl ? kl + ku : n - 1; /* with the fill */
    const int extra = 2 * (BANDED_PANEL - 1) + 1;
    if (right > INT_MAX - extra - kl) return 0;
    return kl + right + extra;
}

/* Number of doubles to provide; 0 if the matrix cannot be stored. */
static inline size_t banded_size(int n, int kl, int ku)
{
    const size_t width = (size_t)banded_width(n, kl, ku);
    if (width == 0 || (size_t)n > SIZE_MAX / sizeof(double) / width) return 0;
    return (size_t)n * width;
}

/* A matrix over banded_size(n, kl, ku) doubles, not yet set to zero. */
static inline banded banded_make(double *memory, int n, int kl, int ku)
{
    banded A;
    A.a = memory;
    A.n = n;
    A.kl = banded_min(kl, n - 1);
    A.ku = banded_min(ku, n - 1);
    A.width = banded_width(n, kl, ku);
    return A;
}

static inline double *banded_at(const banded *A, int i, int j) { return A->a + (size_t)i * (size_t)A->width + (size_t)(j - i + A->kl + BANDED_PANEL - 1); }

static inline void banded_zero(banded *A) { memset(A->a, 0, (size_t)A->n * (size_t)A->width * sizeof *A->a); }

static inline void banded_add(banded *A, int i, int j, double value)
{
    assert(0 <= i && i < A->n && 0 <= j && j < A->n && -A->kl <= j - i && j - i <= A->ku);
    *banded_at(A, i, j) += value;
}

static inline void banded_swap(double *restrict x, double *restrict y, int count)
{
    for (int j = 0; j < count; ++j) {
        const double t = x[j];
        x[j] = y[j];
        y[j] = t;
    }
}

/* y -= l * p */
static inline void banded_axpy(double *restrict y, double l, const double *restrict p, int count)
{
    for (int j = 0; j < count; ++j) y[j] -= l * p[j];
}

/* On x86-64 gcc with glibc makes a copy for AVX2, too, and takes it where the
 * processor has it: wider vectors, the same operations in the same order. */
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define BANDED_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define BANDED_CLONES
#endif

/* y -= l0*p0 + l1*p1 + l2*p2 + l3*p3 in the order of four single updates: the
 * same result, but y is loaded and stored once, which is where the time goes.
 * Four columns per turn, because gcc -O2 makes vectors of equal statements
 * but not of a loop of unknown length. */
BANDED_CLONES static void banded_update(double *restrict y, const double *l, const double *restrict p0, const double *restrict p1, const double *restrict p2,
                                        const double *restrict p3, int count)
{
    const double l0 = l[0], l1 = l[1], l2 = l[2], l3 = l[3];
    int j = 0;
    for (; j < count - 3; j += 4) {
        y[j] = y[j] - l0 * p0[j] - l1 * p1[j] - l2 * p2[j] - l3 * p3[j];
        y[j + 1] = y[j + 1] - l0 * p0[j + 1] - l1 * p1[j + 1] - l2 * p2[j + 1] - l3 * p3[j + 1];
        y[j + 2] = y[j + 2] - l0 * p0[j + 2] - l1 * p1[j + 2] - l2 * p2[j + 2] - l3 * p3[j + 2];
        y[j + 3] = y[j + 3] - l0 * p0[j + 3] - l1 * p1[j + 3] - l2 * p2[j + 3] - l3 * p3[j + 3];
    }
    for (; j < count; ++j) y[j] = y[j] - l0 * p0[j] - l1 * p1[j] - l2 * p2[j] - l3 * p3[j];
}

/* The row of the largest entry in column k at or below the diagonal. */
static inline int banded_pivot(const banded *A, int k, int bottom)
{
    int pivot = k;
    double largest = fabs(*banded_at(A, k, k));
    for (int i = k + 1; i <= bottom; ++i) {
        const double size = fabs(*banded_at(A, i, k));
        if (size > largest) {
            largest = size;
            pivot = i;
        }
    }
    return pivot;
}

/* Eliminate below the diagonal in the columns first to end-1, changing those
 * columns and b only.  The multipliers stay in place of the eliminated entries.
 * *last is the rightmost column that any row so far may reach: without
 * exchanges it grows as the band does, and the fill is never touched. */
static inline int banded_factor_panel(banded *A, double *b, int first, int end, int *last)
{
    for (int k = first; k < end; ++k) {
        const int bottom = k + banded_min(A->kl, A->n - 1 - k);
        const int pivot = banded_pivot(A, k, bottom);
        const int reach = pivot + banded_min(A->ku, A->n - 1 - pivot);
        if (reach > *last) *last = reach;
        if (pivot != k) {
            banded_swap(banded_at(A, k, first), banded_at(A, pivot, first), *last - first + 1);
            banded_swap(b + k, b + pivot, 1);
        }

        const double *p = banded_at(A, k, k);
        if (!(fabs(p[0]) > 0.0 && fabs(p[0]) <= DBL_MAX)) return 1 + k;
        for (int i = k + 1; i <= bottom; ++i) {
            double *row = banded_at(A, i, k);
            if (row[0] == 0.0) continue;
            row[0] /= p[0];
            banded_axpy(row + 1, row[0], p + 1, end - 1 - k);
            b[i] -= row[0] * b[k];
        }
    }
    return 0;
}

/* Bring the columns right of a full panel up to date with its multipliers. */
static inline void banded_apply_panel(banded *A, int first, int last)
{
    const int end = first + BANDED_PANEL, count = last - end + 1;
    const int bottom = end - 1 + banded_min(A->kl, A->n - end);
    const double *p[BANDED_PANEL];

    for (int k = 0; k < BANDED_PANEL; ++k) {
        double *row = banded_at(A, first + k, end);
        for (int m = 0; m < k; ++m) banded_axpy(row, *banded_at(A, first + k, first + m), p[m], count);
        p[k] = row;
    }
    for (int i = end; i <= bottom; ++i) {
        double *l = banded_at(A, i, first);
        if (l[0] != 0.0 || l[1] != 0.0 || l[2] != 0.0 || l[3] != 0.0) banded_update(l + BANDED_PANEL, l, p[0], p[1], p[2], p[3], count);
    }
}

static inline void banded_back_substitute(const banded *A, double *b)
{
    for (int i = A->n - 1; i >= 0; --i) {
        const double *row = banded_at(A, i, i);
        const int count = banded_min(A->kl + A->ku, A->n - 1 - i);
        double sum = b[i];
        for (int j = 1; j <= count; ++j) sum -= row[j] * b[i + j];
        b[i] = sum / row[0];
    }
}

/* Overwrite b with the solution.  Returns 0, or 1 + the column whose pivot is
 * zero or not finite (then b is spoilt).  A is spoilt in either case. */
static inline int banded_factor_solve(banded *A, double *b)
{
    int last = 0;
    for (int first = 0; first < A->n; first += BANDED_PANEL) {
        const int end = first + banded_min(BANDED_PANEL, A->n - first);
        const int status = banded_factor_panel(A, b, first, end, &last);
        if (status != 0) return status;
        if (last >= end) /* never with the short panel at the end */
            banded_apply_panel(A, first, last);
    }
    banded_back_substitute(A, b);
    return 0;
}

#endif
