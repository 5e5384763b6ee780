/* SPDX-License-Identifier: MIT
 *
 * elliptic_schwaiger.h - Schwaiger's scheme as Lukyanov & Vuik 2020 (arXiv:1711.11351) print it, (52) to (55)
 * from nothing but positions and the kernel: to compare with the rows of the headers, which write it as a sum
 * over pairs.
 */
#ifndef ELLIPTIC_SCHWAIGER_H
#define ELLIPTIC_SCHWAIGER_H

#include "elliptic.h"

/* Inverse of the leading dim x dim block, dim 2 or 3, by cofactors */
static inline void schwaiger_inverse(int dim, double A[3][3], double inverse[3][3])
{
    double det = 0;
    int a, b;
    if (dim == 2) {
        A[0][2] = A[1][2] = A[2][0] = A[2][1] = 0;
        A[2][2] = 1;
    }
    for (a = 0; a < 3; a++)
        for (b = 0; b < 3; b++) {
            const int p = (b + 1) % 3, q = (b + 2) % 3, s = (a + 1) % 3, t = (a + 2) % 3;
            inverse[a][b] = A[p][s] * A[q][t] - A[p][t] * A[q][s];
        }
    for (a = 0; a < 3; a++) det += A[0][a] * inverse[a][0];
    for (a = 0; a < 3; a++)
        for (b = 0; b < 3; b++) inverse[a][b] /= det;
}

/* The row of particle i: the factors of u_j into row[] (as the neighbour list), that of u_i into *diagonal.
   gradient: SPH_GRADIENT_DIFFUSE (15), SHEPARD_DIFFUSE (17) or SHEPARD_FULL (18), which are radial.
       L u = tr Gamma^-1 / dim (sum w (m_i + m_j) (u_j - u_i) - N . (grad(m u) - u_i grad m + m_i grad u)),
       grad f = sum g* (f_j - f_i),  g* = Gamma^-1 w e,  Gamma = sum w e e^T,  N = sum w e,
       w = V_j F of (15),  V_j F / nu of (17),  V_j F (1 / nu - V_j W_j / nu^2) of (18),  nu = sum V W,
   with its three gradients kept apart. */
static inline void schwaiger_row(const cloud *c, int i, int gradient, double *row, double *diagonal)
{
    double gamma[3][3] = {{0}}, inverse[3][3], n[3] = {0, 0, 0}, scale = 0,
           nu = c->V[i] * sph_kernel_w(ELLIPTIC_KERNEL, c->dim, 0, c->h);
    const double m_i = c->m[i];
    sph_index p;
    int pass, a, b;
    *diagonal = 0;
    for (pass = 0; pass < 3; pass++) {
        for (p = c->lists.start[i]; p < c->lists.start[i + 1]; p++) {
            const int j = (int)c->lists.index[p];
            const double m_j = c->m[j];
            double e[3], r2 = 0, w, n_star = 0;
            for (a = 0; a < 3; a++) {
                e[a] = cloud_axis(c, a)[j] - cloud_axis(c, a)[i];
                r2 += e[a] * e[a];
            }
            w = c->V[j] * sph_kernel_w(ELLIPTIC_KERNEL, c->dim, sqrt(r2), c->h);
            if (pass == 0) {
                nu += w;
                continue;
            }
            w = (gradient == SPH_GRADIENT_DIFFUSE           ? 1
                 : gradient == SPH_GRADIENT_SHEPARD_DIFFUSE ? 1 / nu
                                                            : 1 / nu - w / (nu * nu)) *
                c->V[j] * sph_kernel_f(ELLIPTIC_KERNEL, c->dim, sqrt(r2), c->h);
            if (pass == 1) {
                for (a = 0; a < c->dim; a++) {
                    n[a] += w * e[a];
                    for (b = 0; b < c->dim; b++) gamma[a][b] += w * e[a] * e[b];
                }
                continue;
            }
            for (a = 0; a < c->dim; a++)
                for (b = 0; b < c->dim; b++) n_star += n[a] * inverse[a][b] * w * e[b]; /* N . g* */
            row[p] = scale * w * (m_i + m_j);
            *diagonal -= scale * w * (m_i + m_j);
            row[p] -= scale * n_star * m_j; /* grad(m u) */
            *diagonal += scale * n_star * m_i;
            *diagonal += scale * n_star * (m_j - m_i); /* -u_i grad m */
            row[p] -= scale * n_star * m_i;            /* m_i grad u */
            *diagonal += scale * n_star * m_i;
        }
        if (pass == 1) {
            schwaiger_inverse(c->dim, gamma, inverse);
            for (a = 0; a < c->dim; a++) scale += inverse[a][a] / c->dim;
        }
    }
}

/* Rows of the first n particles in the place of those that are there. Returns the largest difference of the
   two, of the largest entry of a row. */
static inline double schwaiger_rows(cloud *c, int n, int gradient)
{
    double *const row = (double *)need(NULL, (size_t)c->lists.start[n], sizeof *row), apart = 0;
    sph_index p;
    int i;
    for (i = 0; i < n; i++) {
        double diagonal, size, off;
        schwaiger_row(c, i, gradient, row, &diagonal);
        size = fabs(diagonal);
        off = fabs(diagonal - c->diagonal[i]);
        for (p = c->lists.start[i]; p < c->lists.start[i + 1]; p++) {
            size = fmax(size, fabs(row[p]));
            off = fmax(off, fabs(row[p] - c->row[p]));
            c->row[p] = row[p];
        }
        c->diagonal[i] = diagonal;
        if (!(off / size <= apart)) apart = isfinite(off / size) ? off / size : HUGE_VAL;
    }
    free(row);
    return apart;
}

#endif
