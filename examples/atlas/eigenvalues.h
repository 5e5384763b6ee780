/* SPDX-License-Identifier: MIT
 *
 * eigenvalues.h - the eigenvalues of a real matrix, by the complex QR method: reduction to Hessenberg form by
 * elimination, then steps with Wilkinson's shift and Givens' rotations. Golub & Van Loan, Matrix Computations,
 * chapter 7. For small matrices: some 10 n^3 operations. Complex numbers are pairs, because not every compiler of
 * C99 has them.
 */
#ifndef ATLAS_EIGENVALUES_H
#define ATLAS_EIGENVALUES_H

#include <math.h>
#include <stdlib.h>

typedef struct complex_pair {
    double re, im;
} complex_pair;
static inline complex_pair pair_of(double re, double im)
{
    complex_pair p;
    p.re = re;
    p.im = im;
    return p;
}
static inline complex_pair pair_plus(complex_pair a, complex_pair b) { return pair_of(a.re + b.re, a.im + b.im); }
static inline complex_pair pair_minus(complex_pair a, complex_pair b) { return pair_of(a.re - b.re, a.im - b.im); }
static inline complex_pair pair_times(complex_pair a, complex_pair b) { return pair_of(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re); }
static inline complex_pair pair_conjugate(complex_pair a) { return pair_of(a.re, -a.im); }
static inline double pair_size(complex_pair a) { return hypot(a.re, a.im); }
static inline complex_pair pair_root(complex_pair a)
{
    const double size = pair_size(a), re = sqrt(0.5 * (size + fabs(a.re)));
    if (re == 0.0) return pair_of(0.0, 0.0);
    return a.re >= 0.0 ? pair_of(re, 0.5 * a.im / re) : pair_of(0.5 * fabs(a.im) / re, a.im < 0.0 ? -re : re);
}

/* Both eigenvalues of the last 2 x 2 block; the one that is closer to its last entry. */
static inline complex_pair eigenvalues_shift(complex_pair p, complex_pair q, complex_pair r, complex_pair s)
{
    const complex_pair half_sum = pair_of(0.5 * (p.re + s.re), 0.5 * (p.im + s.im)), half_gap = pair_of(0.5 * (p.re - s.re), 0.5 * (p.im - s.im));
    const complex_pair root = pair_root(pair_plus(pair_times(half_gap, half_gap), pair_times(q, r)));
    const complex_pair one = pair_plus(half_sum, root), two = pair_minus(half_sum, root);
    return pair_size(pair_minus(one, s)) < pair_size(pair_minus(two, s)) ? one : two;
}

/* a: n x n by rows. Returns 1, or 0 if it did not converge or there was no memory. */
static inline int eigenvalues(int n, double *a, complex_pair *value)
{
    complex_pair *const h = (complex_pair *)calloc((size_t)n * (size_t)n + 1, sizeof *h), *const rotation = (complex_pair *)calloc((size_t)n + 1, sizeof *rotation);
    int ok = h != NULL && rotation != NULL, top = n - 1, tries = 0;
    for (int c = 0; ok && c < n - 2; c++) { /* column c has zeros below row c + 1 */
        int best = c + 1;
        for (int r = c + 2; r < n; r++)
            if (fabs(a[r * n + c]) > fabs(a[best * n + c])) best = r;
        if (a[best * n + c] == 0.0) continue;
        for (int q = 0; q < n && best != c + 1; q++) {
            const double keep = a[best * n + q];
            a[best * n + q] = a[(c + 1) * n + q];
            a[(c + 1) * n + q] = keep;
        }
        for (int q = 0; q < n && best != c + 1; q++) {
            const double keep = a[q * n + best];
            a[q * n + best] = a[q * n + c + 1];
            a[q * n + c + 1] = keep;
        }
        for (int r = c + 2; r < n; r++) {
            const double factor = a[r * n + c] / a[(c + 1) * n + c];
            for (int q = c; q < n; q++) a[r * n + q] -= factor * a[(c + 1) * n + q];
            for (int q = 0; q < n; q++) a[q * n + c + 1] += factor * a[q * n + r];
        }
    }
    for (int q = 0; ok && q < n * n; q++) h[q] = pair_of(q / n > q % n + 1 ? 0.0 : a[q], 0.0);
    while (ok && top >= 0) {
        int low = top;
        while (low > 0 && pair_size(h[low * n + low - 1]) > 1e-15 * (pair_size(h[low * n + low]) + pair_size(h[(low - 1) * n + low - 1]))) low--;
        if (low == top) {
            value[top] = h[top * n + top];
            top--;
            tries = 0;
            continue;
        }
        if (++tries > 90) ok = 0;
        const complex_pair last = h[top * n + top], under = h[top * n + top - 1];
        const complex_pair shift = tries % 11 == 10 ? pair_plus(last, pair_of(pair_size(under), 0.0))
                                            : eigenvalues_shift(h[(top - 1) * n + top - 1], h[(top - 1) * n + top], under, last);
        for (int c = low; c <= top; c++) h[c * n + c] = pair_minus(h[c * n + c], shift);
        for (int c = low; c < top; c++) { /* R of QR; the sines are kept in the place of the zeros that they make */
            const complex_pair x = h[c * n + c], y = h[(c + 1) * n + c];
            const double size = hypot(pair_size(x), pair_size(y));
            const complex_pair cosine = size > 0.0 ? pair_of(x.re / size, x.im / size) : pair_of(1.0, 0.0), sine = size > 0.0 ? pair_of(y.re / size, y.im / size) : pair_of(0.0, 0.0);
            for (int j = c; j <= top; j++) {
                const complex_pair upper = h[c * n + j], lower = h[(c + 1) * n + j];
                h[c * n + j] = pair_plus(pair_times(pair_conjugate(cosine), upper), pair_times(pair_conjugate(sine), lower));
                h[(c + 1) * n + j] = pair_minus(pair_times(cosine, lower), pair_times(sine, upper));
            }
            rotation[c] = cosine;
            h[(c + 1) * n + c] = sine;
        }
        for (int c = low; c < top; c++) { /* R Q */
            const complex_pair cosine = rotation[c], sine = h[(c + 1) * n + c];
            h[(c + 1) * n + c] = pair_of(0.0, 0.0);
            for (int i = low; i <= c + 1; i++) {
                const complex_pair left = h[i * n + c], right = h[i * n + c + 1];
                h[i * n + c] = pair_plus(pair_times(cosine, left), pair_times(sine, right));
                h[i * n + c + 1] = pair_minus(pair_times(pair_conjugate(cosine), right), pair_times(pair_conjugate(sine), left));
            }
        }
        for (int c = low; c <= top; c++) h[c * n + c] = pair_plus(h[c * n + c], shift);
    }
    free(h);
    free(rotation);
    return ok;
}

#endif
