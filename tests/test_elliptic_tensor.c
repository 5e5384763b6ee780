/* SPDX-License-Identifier: MIT */
/*
 * test_elliptic_tensor.c - div(M grad u) for a full tensor M: exact for quadratic fields at every particle and for any orientation, also in disorder and at boundaries; of second order
 * for smooth M; rows and applied form agree; the operator for a diagonal M as negative control.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <string.h>

#define KERNEL SPH_WENDLAND_C2
#define EPSILON ((double)SPH_EPSILON)

static const int sides[4] = {0, 21, 13, 8};

/* a symmetric positive tensor, turned at random: M = Q^T Q + 0.2 */
static void random_tensor(int dim, pcg32 *g, double m[3][3])
{
    double q[3][3];
    int a, b, c;
    for (a = 0; a < 3; a++)
        for (b = 0; b < 3; b++) q[a][b] = cloud_symmetric(g);
    for (a = 0; a < 3; a++)
        for (b = 0; b < 3; b++) {
            m[a][b] = a == b ? 0.2 : 0.0;
            for (c = 0; c < dim; c++) m[a][b] += q[c][a] * q[c][b];
        }
}
static double apply_to_hessian(int dim, double m[3][3], const double *d)
{
    static const int at[3][3] = {{3, 4, 6}, {4, 5, 7}, {6, 7, 8}};
    double sum = 0.0;
    int a, b;
    for (a = 0; a < dim; a++)
        for (b = 0; b < dim; b++) sum += m[a][b] * d[at[a][b]];
    return sum;
}
static void put(const cloud *c, sph_real *m, sph_index i, double t[3][3])
{
    int a, b;
    for (a = 0; a < c->dim; a++)
        for (b = 0; b < c->dim; b++) m[((int)i * c->dim + a) * c->dim + b] = SPH_R(t[a][b]);
}

static void test_quadratic(void)
{
    int dim, ordered, turn;
    for (dim = 1; dim <= 3; dim++)
        for (ordered = 0; ordered < 2; ordered++) {
            cloud c = cloud_lattice(dim, sides[dim], 1.5, ordered ? 0.0 : 0.25, 3);
            sph_real *const m = (sph_real *)cloud_memory((size_t)(c.n * dim * dim), sizeof *m), *const h = (sph_real *)cloud_memory((size_t)c.n, sizeof *h);
            sph_real *const found = (sph_real *)cloud_memory((size_t)c.n, sizeof *found), *const row = (sph_real *)cloud_memory((size_t)c.pairs, sizeof *row);
            sph_real *const diagonal = (sph_real *)cloud_memory((size_t)c.n, sizeof *diagonal), *const by_rows = (sph_real *)cloud_memory((size_t)c.n, sizeof *by_rows);
            sph_real *const conditioning = (sph_real *)cloud_memory((size_t)c.n, sizeof *h);
            unsigned char *const status = (unsigned char *)cloud_memory((size_t)c.n, 1);
            pcg32 g;
            sph_index i;
            pcg32_seed(&g, 11, (uint64_t)dim);
            if (!ordered) cloud_random_volumes(&c, 5);
            for (i = 0; i < c.n; i++) h[i] = c.h * SPH_R(ordered ? 1.0 : 1.0 - 0.1 * (i % 3) / 2.0);
            cloud_set(&c, field_quadratic);
            for (turn = 0; turn < 4; turn++) {
                const sph_cloud all = sph_cloud_of(cloud_points(&c), cloud_list(&c), sph_scalars_array(h), cloud_V(&c));
                const sph_matrices M = sph_matrices_packed(dim, m);
                double t[3][3], scale = 0.0;
                random_tensor(dim, &g, t);
                for (i = 0; i < c.n; i++) put(&c, m, i, t);
                for (i = 0; i < 9; i++) scale = fmax(scale, fabs(t[i / 3][i % 3]));
                CHECK(sph_elliptic_tensor(KERNEL, dim, all, M, cloud_f(&c), sph_scalar_out_array(found, status)) == 0);
                CHECK(sph_elliptic_rows_tensor(KERNEL, dim, all, M, (sph_rows_out){.row = row, .diagonal = diagonal, .conditioning = conditioning}) == 0);
                CHECK(sph_rows_apply(all, row, sph_scalars_array(diagonal), cloud_f(&c), sph_scalar_out_array(by_rows, 0)) == 0);
                for (i = 0; i < c.n; i++) {
                    double p[3], d[9], bound, expected;
                    cloud_position(&c, i, p);
                    field_quadratic(p, d);
                    expected = apply_to_hessian(dim, t, d);
                    bound = 300.0 * EPSILON * scale / (c.dx * c.dx) / fmax((double)conditioning[i], 1e-3);
                    CHECK_NEAR(check_words("div(M grad u) of a quadratic u in %dD", dim), i, found[i], expected, bound);
                    CHECK_NEAR(check_words("rows of div(M grad u) in %dD", dim), i, by_rows[i], found[i], bound);
                    CHECK_SAME("status", i, status[i], SPH_OK);
                    if (!ordered) continue;
                    CHECK_AT("conditioning", i, cloud_walls(&c, i) || (double)conditioning[i] > 0.02);
                }
            }
            free(m);
            free(h);
            free(found);
            free(row);
            free(diagonal);
            free(by_rows);
            free(conditioning);
            free(status);
            cloud_free(&c);
        }
}

/* M and u linear: div(M grad u) = (div M) . grad u, exact, too */
static void test_linear_mobility(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, sides[dim], 1.5, 0.2, 8);
        sph_real *const m = (sph_real *)cloud_memory((size_t)(c.n * dim * dim), sizeof *m), *const found = (sph_real *)cloud_memory((size_t)c.n, sizeof *found);
        double slope[3][3][3], divergence[3] = {0.0, 0.0, 0.0}, expected = 0.0, worst = 0.0;
        double d[9];
        pcg32 g;
        sph_index i;
        int a, b, k;
        pcg32_seed(&g, 4, 4);
        for (a = 0; a < 3; a++)
            for (b = 0; b <= a; b++)
                for (k = 0; k < 3; k++) slope[a][b][k] = slope[b][a][k] = 0.3 * cloud_symmetric(&g);
        cloud_set(&c, field_linear);
        for (i = 0; i < c.n; i++) {
            double p[3], t[3][3];
            cloud_position(&c, i, p);
            field_linear(p, d);
            for (a = 0; a < dim; a++)
                for (b = 0; b < dim; b++) {
                    t[a][b] = a == b ? 2.0 : 0.5;
                    for (k = 0; k < dim; k++) t[a][b] += slope[a][b][k] * p[k];
                }
            put(&c, m, i, t);
        }
        for (a = 0; a < dim; a++) {
            for (b = 0; b < dim; b++) divergence[a] += slope[a][b][b];
            expected += divergence[a] * d[a];
        }
        CHECK(sph_elliptic_tensor(KERNEL, dim, cloud_view(&c), sph_matrices_packed(dim, m), cloud_f(&c), sph_scalar_out_array(found, 0)) == 0);
        for (i = 0; i < c.n; i++) worst = fmax(worst, fabs((double)found[i] - expected));
        CHECK_WORST(check_words("div(M grad u), both linear, in %dD", dim), worst, 2e4 * EPSILON / c.dx);
        free(m);
        free(found);
        cloud_free(&c);
    }
}

/* Smooth M, turned by an angle that changes from place to place, and a smooth u on a lattice: second order in the interior. In float rounding errors prevail. */
static double error_of(int side)
{
    cloud c = cloud_lattice(2, side, 1.5, 0.0, 1);
    sph_real *const m = (sph_real *)cloud_memory((size_t)c.n * 4, sizeof *m), *const found = (sph_real *)cloud_memory((size_t)c.n, sizeof *found);
    double worst = 0.0;
    sph_index i;
    cloud_set(&c, field_smooth);
    for (i = 0; i < c.n; i++) {
        double p[3], t[3][3];
        cloud_position(&c, i, p);
        t[0][0] = 1.0 + 0.5 * p[0] * p[1];
        t[0][1] = t[1][0] = 0.6 * sin(p[0] + 2.0 * p[1]);
        t[1][1] = 2.0 + cos(p[0]);
        put(&c, m, i, t);
    }
    CHECK(sph_elliptic_tensor(KERNEL, 2, cloud_view(&c), sph_matrices_packed(2, m), cloud_f(&c), sph_scalar_out_array(found, 0)) == 0);
    for (i = 0; i < c.n; i++) {
        double p[3], d[9], exact;
        cloud_position(&c, i, p);
        if (fmin(fmin(p[0], 1.0 - p[0]), fmin(p[1], 1.0 - p[1])) < 0.3) continue;
        field_smooth(p, d);
        exact = (1.0 + 0.5 * p[0] * p[1]) * d[3] + 1.2 * sin(p[0] + 2.0 * p[1]) * d[4] + (2.0 + cos(p[0])) * d[5];
        exact += (0.5 * p[1] + 1.2 * cos(p[0] + 2.0 * p[1])) * d[0] + 0.6 * cos(p[0] + 2.0 * p[1]) * d[1]; /* div M . grad u */
        worst = fmax(worst, fabs((double)found[i] - exact));
    }
    free(m);
    free(found);
    cloud_free(&c);
    return worst;
}
static void test_order(void)
{
    double coarse, fine;
    if (SPH_SINGLE) return;
    coarse = error_of(17);
    fine = error_of(33);
    CHECK_CLOSE(log(coarse / fine) / log(2.0), 2.0, 0.15);
}

/* Beside the operator for a diagonal M: the same numbers on a lattice for M along the axes; and negative control: M turned by 45 degrees has the same diagonal as an isotropic one. */
static void test_beside_diagonal(void)
{
    cloud c = cloud_lattice(2, 13, 1.5, 0.0, 1);
    sph_real *const m = (sph_real *)cloud_memory((size_t)c.n * 4, sizeof *m), *const row = (sph_real *)cloud_memory(2 * (size_t)c.pairs, sizeof *row);
    sph_real *const found = (sph_real *)cloud_memory((size_t)c.n, sizeof *found);
    double along[3][3] = {{1.0, 0.0, 0.0}, {0.0, 4.0, 0.0}, {0.0, 0.0, 0.0}}, turned[3][3] = {{2.5, -1.5, 0.0}, {-1.5, 2.5, 0.0}, {0.0, 0.0, 0.0}};
    sph_index i, p;
    const sph_index middle = c.n / 2;
    const sph_matrices M = sph_matrices_packed(2, m);
    sph_diagonal d;
    d.x = M.x.x;
    d.y = M.y.y;
    d.z = M.z.z;
    cloud_set(&c, field_quadratic);
    for (i = 0; i < c.n; i++) put(&c, m, i, along);
    CHECK(sph_elliptic_rows_tensor(KERNEL, 2, cloud_view(&c), M, (sph_rows_out){.row = row}) == 0);
    CHECK(sph_elliptic_rows_anisotropic(KERNEL, 2, cloud_view(&c), d, (sph_rows_out){.row = row + c.pairs}) == 0);
    for (p = c.start[middle]; p < c.start[middle + 1]; p++) CHECK_NEAR("row of a diagonal M", middle, row[p], row[p + c.pairs], 1e4 * EPSILON);
    for (i = 0; i < c.n; i++) put(&c, m, i, turned);
    CHECK(sph_elliptic_tensor(KERNEL, 2, cloud_view(&c), M, cloud_f(&c), sph_scalar_out_array(found, 0)) == 0);
    CHECK_CLOSE((double)found[middle], 2.5 * (2.2 - 1.4) - 2.0 * 1.5 * 0.9, 1e5 * EPSILON);
    CHECK(sph_elliptic_rows_anisotropic(KERNEL, 2, cloud_view(&c), d, (sph_rows_out){.row = row}) == 0);
    CHECK(sph_rows_apply(cloud_view(&c), row, sph_scalars_none(), cloud_f(&c), sph_scalar_out_array(found, 0)) == 0);
    CHECK(fabs((double)found[middle] - (2.5 * (2.2 - 1.4) - 2.0 * 1.5 * 0.9)) > 1.0);
    free(m);
    free(row);
    free(found);
    cloud_free(&c);
}

/* Neighbours on the axes alone do not see xy: status, and nothing but zeros. The symmetric part of M is what counts. */
static void test_degenerate_and_symmetric(void)
{
    cloud c = cloud_lattice(2, 9, 0.6, 0.0, 1), full = cloud_lattice(2, 9, 1.5, 0.2, 1);
    sph_real *const m = (sph_real *)cloud_memory((size_t)c.n * 4, sizeof *m), *const found = (sph_real *)cloud_memory(2 * (size_t)c.n, sizeof *found);
    unsigned char *const status = (unsigned char *)cloud_memory((size_t)c.n, 1);
    double one[3][3] = {{1.0, 0.9, 0.0}, {-0.3, 2.0, 0.0}, {0.0, 0.0, 0.0}}, other[3][3] = {{1.0, 0.3, 0.0}, {0.3, 2.0, 0.0}, {0.0, 0.0, 0.0}};
    sph_index i;
    cloud_set(&c, field_quadratic);
    cloud_set(&full, field_quadratic);
    for (i = 0; i < c.n; i++) put(&c, m, i, one);
    CHECK(sph_elliptic_tensor(KERNEL, 2, cloud_view(&c), sph_matrices_packed(2, m), cloud_f(&c), sph_scalar_out_array(found, status)) == c.n);
    for (i = 0; i < c.n; i++) {
        CHECK_SAME("status of four neighbours", i, status[i], SPH_SINGULAR);
        CHECK_AT("result of four neighbours", i, found[i] == SPH_R(0));
    }
    CHECK(sph_elliptic_tensor(KERNEL, 2, cloud_view(&full), sph_matrices_packed(2, m), cloud_f(&full), sph_scalar_out_array(found, 0)) == 0);
    for (i = 0; i < c.n; i++) put(&c, m, i, other);
    CHECK(sph_elliptic_tensor(KERNEL, 2, cloud_view(&full), sph_matrices_packed(2, m), cloud_f(&full), sph_scalar_out_array(found + c.n, 0)) == 0);
    for (i = 0; i < c.n; i++) CHECK_NEAR("symmetric part", i, found[i], found[i + c.n], 1e5 * EPSILON);
    free(m);
    free(found);
    free(status);
    cloud_free(&c);
    cloud_free(&full);
}

int main(void)
{
    test_quadratic();
    test_linear_mobility();
    test_order();
    test_beside_diagonal();
    test_degenerate_and_symmetric();
    return check_report("test_elliptic_tensor");
}
