/* SPDX-License-Identifier: MIT */
/* statistics.h - order statistics and a straight-line fit. */
#ifndef STATISTICS_H
#define STATISTICS_H

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* Ascending, with NaN last: qsort needs a total order. */
static inline int statistics_compare(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    if (isnan(a) || isnan(b)) return (isnan(a) != 0) - (isnan(b) != 0);
    return (a > b) - (a < b);
}

static inline void statistics_sort(double *value, int n) { qsort(value, (size_t)n, sizeof *value, statistics_compare); }

/* The p-quantile of an ascending array, 0 <= p <= 1: linear interpolation at
 * the position (n-1)p counted from 0.  This is definition 7 of Hyndman and Fan,
 * The American Statistician 50 (1996) 361, the default of R and NumPy. */
static inline double statistics_quantile(const double *sorted, int n, double p)
{
    if (n < 1 || !(p >= 0.0 && p <= 1.0)) return (double)NAN;
    const double position = (n - 1) * p;
    const int below = (int)position;
    const double fraction = position - below;
    if (fraction == 0.0) /* below may be the last */
        return sorted[below];
    return sorted[below] + fraction * (sorted[below + 1] - sorted[below]);
}

/* Where a value stands in an ascending array, from 0 (below all) to 1 (above
 * all): the fraction of entries less than it, plus half of those equal to it. */
static inline double statistics_rank(const double *sorted, int n, double value)
{
    int less = 0, equal = 0;
    if (n < 1 || isnan(value)) return (double)NAN;
    for (int k = 0; k < n; ++k) {
        less += sorted[k] < value;
        equal += sorted[k] == value;
    }
    return (less + 0.5 * equal) / n;
}

/* Slope of the least-squares line through (x, y); NaN if it has none. */
static inline double statistics_slope(const double *x, const double *y, int n)
{
    double x_mean = 0.0, y_mean = 0.0, xx = 0.0, xy = 0.0;
    for (int k = 0; k < n; ++k) {
        x_mean += x[k] / n;
        y_mean += y[k] / n;
    }
    for (int k = 0; k < n; ++k) { /* about the means: no cancellation */
        xx += (x[k] - x_mean) * (x[k] - x_mean);
        xy += (x[k] - x_mean) * (y[k] - y_mean);
    }
    return xy / xx; /* 0/0 where x does not vary */
}

#endif
