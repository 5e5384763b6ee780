/* SPDX-License-Identifier: MIT
 *
 * eigenvalues.h - the eigenvalues of a real matrix, by the complex QR method: reduction to Hessenberg form by
 * Householder's reflections, then steps with Wilkinson's shift and Givens' rotations. Golub & Van Loan, Matrix
 * Computations, chapter 7. For small matrices: some 10 n^3 operations.
 */
#ifndef ATLAS_EIGENVALUES_H
#define ATLAS_EIGENVALUES_H

#include <complex.h>
#include <math.h>
#include <stdlib.h>

/* a: n x n by rows. Returns 1, or 0 if it did not converge or there was no memory. */
static inline int eigenvalues(int n, const double *a, double complex *value)
{
    double complex *const h = (double complex *)malloc((size_t)n * (size_t)n * sizeof *h), *const v = (double complex *)malloc((size_t)n * sizeof *v);
    int ok = h != NULL && v != NULL, top = n - 1, tries = 0;
    for (int q = 0; ok && q < n * n; q++) h[q] = a[q];
    for (int c = 0; ok && c < n - 2; c++) { /* h = (1 - 2 v v^H) h (1 - 2 v v^H) */
        double size = 0.0, rest = 0.0;
        for (int r = c + 1; r < n; r++) size += creal(h[r * n + c] * conj(h[r * n + c]));
        size = sqrt(size);
        if (size == 0.0) continue;
        for (int r = c + 1; r < n; r++) v[r] = h[r * n + c];
        v[c + 1] += cabs(v[c + 1]) > 0.0 ? v[c + 1] / cabs(v[c + 1]) * size : size;
        for (int r = c + 1; r < n; r++) rest += creal(v[r] * conj(v[r]));
        rest = sqrt(rest);
        for (int r = c + 1; r < n; r++) v[r] /= rest;
        for (int q = 0; q < n; q++) {
            double complex sum = 0.0;
            for (int r = c + 1; r < n; r++) sum += conj(v[r]) * h[r * n + q];
            for (int r = c + 1; r < n; r++) h[r * n + q] -= 2.0 * v[r] * sum;
        }
        for (int q = 0; q < n; q++) {
            double complex sum = 0.0;
            for (int r = c + 1; r < n; r++) sum += h[q * n + r] * v[r];
            for (int r = c + 1; r < n; r++) h[q * n + r] -= 2.0 * sum * conj(v[r]);
        }
    }
    while (ok && top >= 0) {
        int low = top;
        while (low > 0 && cabs(h[low * n + low - 1]) > 1e-15 * (cabs(h[low * n + low]) + cabs(h[(low - 1) * n + low - 1]))) low--;
        if (low == top) {
            value[top] = h[top * n + top];
            top--;
            tries = 0;
            continue;
        }
        if (++tries > 60) ok = 0;
        const double complex p = h[(top - 1) * n + top - 1], q = h[(top - 1) * n + top], r = h[top * n + top - 1], s = h[top * n + top],
                             root = csqrt(0.25 * (p - s) * (p - s) + q * r), one = 0.5 * (p + s) + root, two = 0.5 * (p + s) - root;
        const double complex shift = tries % 11 == 10 ? s + cabs(r) : cabs(one - s) < cabs(two - s) ? one : two;
        for (int c = low; c <= top; c++) h[c * n + c] -= shift;
        /* R of QR by rotations of two rows, which are kept in v and in place of the zeros they make */
        for (int c = low; c < top; c++) {
            const double complex x = h[c * n + c], y = h[(c + 1) * n + c];
            const double size = sqrt(creal(x * conj(x)) + creal(y * conj(y)));
            const double complex cosine = size > 0.0 ? x / size : 1.0, sine = size > 0.0 ? y / size : 0.0;
            for (int j = c; j <= top; j++) {
                const double complex upper = h[c * n + j], lower = h[(c + 1) * n + j];
                h[c * n + j] = conj(cosine) * upper + conj(sine) * lower;
                h[(c + 1) * n + j] = cosine * lower - sine * upper;
            }
            v[c] = cosine;
            h[(c + 1) * n + c] = sine;
        }
        for (int c = low; c < top; c++) { /* R Q */
            const double complex cosine = v[c], sine = h[(c + 1) * n + c];
            h[(c + 1) * n + c] = 0.0;
            for (int i = low; i <= c + 1; i++) {
                const double complex left = h[i * n + c], right = h[i * n + c + 1];
                h[i * n + c] = cosine * left + sine * right;
                h[i * n + c + 1] = conj(cosine) * right - conj(sine) * left;
            }
        }
        for (int c = low; c <= top; c++) h[c * n + c] += shift;
    }
    free(h);
    free(v);
    return ok;
}

#endif
