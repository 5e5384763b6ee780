/* SPDX-License-Identifier: MIT
 *
 * elliptic_system.h - from rows to solutions: boundary conditions on the faces of a box, the matrix, a solve that ends the program if it fails.
 *
 *     cloud_rows(&c, SCHEME_M, (sph_elliptic_options){0});
 *     cloud_box_conditions(&c, first, dirichlet);       rows of the particles from `first` on, which lie on the faces of the box c.low ... c.high
 *     cloud_matrix(&c, &A, b);                          rows scaled to a diagonal of 1, b with them;
 *                                                       cloud_matrix_unscaled(&c, &A): not
 *     elliptic_solve(&A, b, u);
 */
#ifndef ELLIPTIC_SYSTEM_H
#define ELLIPTIC_SYSTEM_H

#include "../common/sparse.h"
#include "elliptic.h"

/* Ends the program unless the matrix, or what else `answer` is about, was made. */
static inline void elliptic_made(int answer, const char *what)
{
    if (answer == 0) return;
    fprintf(stderr, "elliptic: no %s: %s\n", what, sparse_answer_text(answer));
    exit(2);
}

static inline double *elliptic_vector(int n) { return (double *)need_zeros((size_t)n, sizeof(double)); }

/* alpha u + beta m du/dn for the particles from `first` on that have one of them. all: cloud_all(c), or one
   with an h of each particle's own; SPH_FN, so that its strides fold. */
SPH_FN void cloud_conditions(cloud *c, sph_cloud all, int first, double *const normal[3], const double *alpha,
                             const double *beta)
{
    const sph_cloud those = sph_cloud_range(all, first, c->n);
    const sph_scalars m = sph_scalars_array(c->m);
    const sph_elliptic_options o = {0};
    const sph_boundary on = {vectors_of(normal, 3), sph_scalars_array(alpha), sph_scalars_array(beta)};
    const sph_rows_out out = {.row = c->row, .diagonal = c->diagonal};
    expect(WITH_DIM_2_3(sph_elliptic_rows_boundary, ELLIPTIC_KERNEL, ELLIPTIC_DIM(c), those, m, o, on, out));
}
/* dirichlet[i] for i >= first: 1 for u, 0 for the flux m du/dn through the face that particle i lies on (100) */
static inline void cloud_box_conditions(cloud *c, int first, const unsigned char *dirichlet)
{
    double *const normal[3] = {elliptic_vector(c->n), elliptic_vector(c->n), elliptic_vector(c->n)},
                  *const alpha = elliptic_vector(c->n), *const beta = elliptic_vector(c->n);
    int i, a;
    for (i = first; i < c->n; i++) {
        for (a = 0; a < c->dim; a++)
            normal[a][i] = cloud_axis(c, a)[i] == c->low[a] ? -1 : cloud_axis(c, a)[i] == c->high[a] ? 1 : 0;
        alpha[i] = dirichlet[i];
        beta[i] = !dirichlet[i];
    }
    cloud_conditions(c, cloud_all(c), first, normal, alpha, beta);
    for (a = 0; a < 3; a++) free(normal[a]);
    free(alpha);
    free(beta);
}

/* The matrix of c->row and c->diagonal, without what is 0, as it is */
static inline void cloud_matrix_unscaled(const cloud *c, sparse *A)
{
    const int64_t room = sph_csr_size(cloud_all(c));
    sph_index *const start = (sph_index *)need(NULL, (size_t)c->n + 1, sizeof *start);
    int i;
    A->n = c->n;
    A->start = (int64_t *)need(NULL, (size_t)c->n + 1, sizeof *A->start);
    A->index = (int *)need(NULL, (size_t)room, sizeof *A->index);
    A->value = (double *)need(NULL, (size_t)room, sizeof *A->value);
    expect(sph_csr_assemble(cloud_all(c), c->row, sph_scalars_array(c->diagonal), 1,
                            (sph_csr){start, A->index, A->value, room}, NULL));
    for (i = 0; i <= c->n; i++) A->start[i] = start[i];
    free(start);
}
static inline void cloud_matrix(const cloud *c, sparse *A, double *b)
{
    cloud_matrix_unscaled(c, A);
    if (sparse_scale_rows(A, b) != 0) {
        fprintf(stderr, "elliptic: a row of the matrix has no diagonal: a particle without neighbours?\n");
        exit(1);
    }
}

/* Where Brookshaw's rows all but vanish (f = 0.5005) the solution is 1e6 times the data, and no x has a small residual against b: it is judged against |A| |x| then. */
static inline int elliptic_solved(const sparse *A, const double *b, const double *u, sparse_result r)
{
    const double data = sparse_norm(A->n, b);
    return r.converged ||
           r.residual * data <=
               1e-13 *
                   (data + 2 * sparse_norm(A->n, u)); /* |A| is near 2: rows are scaled to a diagonal of 1 */
}
/* u is the first guess, too */
static inline void elliptic_solve(const sparse *A, const double *b, double *u)
{
    sparse_options o = sparse_defaults();
    sparse_preconditioner P;
    sparse_result r;
    o.tolerance = 1e-12;
    o.max_iterations = 4000;
    o.restart = 60;
    elliptic_made(sparse_preconditioner_make(&P, SPARSE_ILU0, A), "incomplete factorisation");
    r = sparse_bicgstab(A, &P, b, u, &o);
    if (!elliptic_solved(A, b, u, r)) r = sparse_gmres(A, &P, b, u, &o);
    sparse_preconditioner_free(&P);
    if (!elliptic_solved(A, b, u, r)) {
        fprintf(stderr, "elliptic: %s, residual %.2g after %d iterations\n", sparse_status_text(r.status),
                r.residual, r.iterations);
        exit(1);
    }
}

#endif
