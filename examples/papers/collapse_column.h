/* SPDX-License-Identifier: MIT
 *
 * collapse_column.h - column density of particles: the mass along a line of sight, each particle's by the line integral of its kernel.
 *     integral of W(sqrt(R^2 + s^2), h) ds = sigma / h^2 Y(R / h),   Y(q) = 2 integral_0^sqrt(support^2 - q^2) w(sqrt(q^2 + s^2)) ds
 */
#ifndef COLLAPSE_COLUMN_H
#define COLLAPSE_COLUMN_H

#include <math.h>

#include "../../sph.h"

enum { COLUMN_TABLE = 512, COLUMN_PANELS = 200 };
typedef struct column_table {
    double y[COLUMN_TABLE + 1], support;
} column_table;

/* sigma Y, by Simpson's rule in an angle (s = sqrt(support^2 - q^2) sin), where the ends are smooth */
static inline column_table column_table_of(sph_kernel kernel)
{
    column_table t;
    int k, p;
    t.support = sph_kernel_support_ratio(kernel);
    for (k = 0; k <= COLUMN_TABLE; k++) {
        const double q = t.support * k / COLUMN_TABLE, half_chord = sqrt(fmax(0, t.support * t.support - q * q)), step = acos(-1) / 2 / COLUMN_PANELS;
        double sum = 0;
        for (p = 0; p <= COLUMN_PANELS; p++) {
            const double s = half_chord * sin(p * step), weight = p == 0 || p == COLUMN_PANELS ? 1 : p % 2 ? 4 : 2;
            sum += weight * sph_kernel_shape(kernel, 3, sqrt(q * q + s * s)) * half_chord * cos(p * step);
        }
        t.y[k] = sph_kernel_sigma(kernel, 3) * 2 * sum * step / 3;
    }
    return t;
}
/* sigma Y(q), linear between the table's values; 0 beyond the support */
static inline double column_shape(const column_table *t, double q)
{
    const double at = q / t->support * COLUMN_TABLE;
    const int k = (int)at;
    return k >= COLUMN_TABLE ? 0 : t->y[k] + (at - k) * (t->y[k + 1] - t->y[k]);
}
/* Adds the particles' columns, each times its weight (null: 1), to the pixels, side x side of them over [-half, half]^2, row by row; x, y: coordinates across the line of sight from the middle. A kernel narrower than a pixel is widened to
   it, so that its mass is seen. */
static inline void column_add(const column_table *t, int n, const double *x, const double *y, const double *h, double m, const double *weight, double half,
                              int side, double *pixel)
{
    const double width = 2 * half / side;
    int i, a, b;
    for (i = 0; i < n; i++) {
        const double wide = fmax(h[i], width), reach = t->support * wide;
        const int a0 = (int)fmax(0, floor((x[i] - reach + half) / width)), a1 = (int)fmin(side - 1, floor((x[i] + reach + half) / width));
        const int b0 = (int)fmax(0, floor((y[i] - reach + half) / width)), b1 = (int)fmin(side - 1, floor((y[i] + reach + half) / width));
        for (b = b0; b <= b1; b++)
            for (a = a0; a <= a1; a++)
                pixel[b * side + a] += (weight ? weight[i] : 1) * m / (wide * wide) *
                                       column_shape(t, hypot((a + 0.5) * width - half - x[i], (b + 0.5) * width - half - y[i]) / wide);
    }
}

#endif
