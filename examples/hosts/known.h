/* SPDX-License-Identifier: MIT
 *
 * known.h - the known answers (tests/known/kernels.csv) for the C, C++, OpenCL and CUDA hosts: W and F of
 * every kernel in 1D, 2D, 3D.
 *
 *     static known_row row[KNOWN_MAX];
 *     int rows = known_read("tests/known/kernels.csv", row);        0: not there, or not such a file
 *     int bad = known_compare(rows, row, w, f, 8 * SPH_EPSILON);    how many of the computed w[i], f[i] are
 *                                                                   off by more than this, relative to the
 *                                                                   largest of their kernel, dimension and h
 */
#ifndef KNOWN_H
#define KNOWN_H

#include "sph.h"

#include <stdio.h>
#include <string.h>

enum { KNOWN_MAX = 4096 };
typedef struct known_row {
    char name[32];
    int kernel, dim;
    double h, r, w, f;
} known_row;

static inline int known_read(const char *path, known_row *row)
{
    char line[1024];
    int rows = 0;
    FILE *const file = fopen(path, "r");
    if (!file) return 0;
    while (rows < KNOWN_MAX && fgets(line, (int)sizeof line, file)) {
        known_row *const a = &row[rows];
        if (line[0] == '#' || strncmp(line, "kernel,", 7) == 0)
            continue; /* kernel,dim,h,r,sigma,W,dWdr,F,... */
        if (sscanf(line, "%31[^,],%d,%lf,%lf,%*[^,],%lf,%*[^,],%lf", a->name, &a->dim, &a->h, &a->r, &a->w,
                   &a->f) != 6)
            break;
        a->kernel = sph_kernel_from_name(a->name);
        if (a->kernel < 0) break;
        rows++;
    }
    if (!feof(file)) rows = 0;
    fclose(file);
    return rows;
}

static inline double known_larger(double a, double b) { return a > fabs(b) ? a : fabs(b); }
static inline int known_compare(int rows, const known_row *row, const sph_real *w, const sph_real *f,
                                double tolerance)
{
    double largest_w = 0, largest_f = 0;
    int i, j, bad = 0;
    for (i = 0; i < rows; i++) {
        if (i == 0 || row[i].kernel != row[i - 1].kernel || row[i].dim != row[i - 1].dim ||
            row[i].h < row[i - 1].h || row[i].h > row[i - 1].h)
            for (largest_w = largest_f = 0, j = i;
                 j < rows && row[j].kernel == row[i].kernel && row[j].dim == row[i].dim &&
                 !(row[j].h < row[i].h || row[j].h > row[i].h);
                 j++) {
                largest_w = known_larger(largest_w, row[j].w);
                largest_f = known_larger(largest_f, row[j].f);
            }
        if (fabs((double)w[i] - row[i].w) <= tolerance * largest_w &&
            fabs((double)f[i] - row[i].f) <= tolerance * largest_f)
            continue;
        if (bad++ < 5)
            printf("%s, dim %d, h %g, r %g: W %.9g, F %.9g, should be %.9g, %.9g\n", row[i].name, row[i].dim,
                   row[i].h, row[i].r, (double)w[i], (double)f[i], row[i].w, row[i].f);
    }
    return bad;
}

#endif
