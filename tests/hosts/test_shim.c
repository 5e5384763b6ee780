/* SPDX-License-Identifier: MIT */
/*
 * test_shim.c - the exported functions of examples/hosts/sph_shim.h, which are linked with, against the inline functions that they stand for: every kernel, every dimension, and refusals.
 *
 *     test_shim [path of kernels.csv]
 */
#include "examples/hosts/known.h"
#include "examples/hosts/sph_shim.h"
#include "tests/check.h"
#include "tests/clouds.h"

enum { MAX_N = 512, MAX_PAIRS = 512 * 300 };
static sph_real a[9 * MAX_N], b[9 * MAX_N], c[MAX_N], d[MAX_N], e[MAX_N], g[MAX_N], row[MAX_PAIRS], other[MAX_PAIRS];
static unsigned char status[MAX_N], status_inline[MAX_N];
static double work[MAX_N * 8], space[64];

/* The same sums, compiled twice: equal but for rounding, which amplifies where a matrix is nearly singular. NaN is not. */
static int same(size_t n, const sph_real *p, const sph_real *q, double tolerance)
{
    double largest = 0, off = 0;
    size_t i;
    for (i = 0; i < n; i++) {
        const double difference = fabs((double)p[i] - (double)q[i]);
        if (!(difference <= off)) off = difference;
        largest = known_larger(largest, (double)p[i]);
    }
    return largest > 0 && off <= tolerance * largest;
}

static void test_known(const char *path)
{
    static known_row known[KNOWN_MAX];
    static sph_real w[KNOWN_MAX], f[KNOWN_MAX];
    const int rows = known_read(path, known);
    int i;
    CHECK(rows > 500);
    for (i = 0; i < rows; i++) {
        const sph_real r = SPH_R(known[i].r);
        CHECK(sph_shim_kernel_from_name(known[i].name) == known[i].kernel);
        CHECK(sph_shim_kernel_wf(known[i].kernel, known[i].dim, 1, &r, SPH_R(known[i].h), &w[i], &f[i]) == 0);
    }
    CHECK(known_compare(rows, known, w, f, 8 * (double)SPH_EPSILON) == 0);
    if (rows == 0) return;
    w[0] += SPH_R(1e-3); /* the comparison sees it */
    printf("made wrong: ");
    CHECK(known_compare(1, known, w, f, 8 * (double)SPH_EPSILON) == 1);
}

static void test_cloud(int kernel, int dim)
{
    const sph_kernel k = (sph_kernel)kernel;
    const int sides[] = {40, 14, 7}, numbers = dim + dim * (dim + 1) / 2;
    const double tolerance = BY_PRECISION(1e-11, 2e-3);
    cloud x = cloud_lattice(dim, sides[dim - 1], 1.3, 0.2, 7);
    sph_shim_cloud *const s = (sph_shim_cloud *)(void *)space;
    const sph_real radius = sph_kernel_support_ratio(k) * x.h, least = SPH_R(0.02);
    const sph_index first = x.n / 4, last = x.n - 1;
    sph_index start[MAX_N + 1], *index = (sph_index *)cloud_memory(MAX_PAIRS, sizeof *index);
    sph_elliptic_options options = {0};
    sph_derivatives_out out = {0};
    sph_rows_out rows = {0};
    sph_list list;
    sph_cloud all, part;
    size_t found;
    int64_t pairs = 0;
    cloud_set(&x, field_smooth);
    CHECK(x.n <= MAX_N && sph_shim_cloud_size() <= sizeof space && sph_shim_grid_workspace(dim, x.n) <= sizeof work);
    CHECK(sph_shim_cloud_init(s, kernel, dim, x.n, x.x, x.y, x.z, 1) == 0);
    sph_shim_cloud_volumes(s, &x.h, 0, x.V, 1);

    CHECK(sph_shim_grid_lists(s, SPH_GATHER, &radius, 0, work, sizeof work, start, index, 1, &pairs) == SPH_ERROR_CAPACITY);
    CHECK(pairs > x.n && pairs <= MAX_PAIRS);
    CHECK(sph_shim_grid_lists(s, SPH_GATHER, &radius, 0, work, sizeof work, start, index, MAX_PAIRS, &pairs) == 0);
    CHECK(pairs == start[x.n]);
    found = (size_t)pairs;
    sph_shim_cloud_lists(s, start, index);
    list.start = start;
    list.index = index;
    all = sph_cloud_of(cloud_points(&x), list, cloud_h(&x), cloud_V(&x));
    part = sph_cloud_range(all, first, last);

    CHECK(sph_shim_density_summation(s, x.V, 1, a) == sph_density_summation(k, dim, all, cloud_V(&x), sph_scalar_out_array(b, 0)));
    CHECK(same((size_t)x.n, a, b, tolerance));

    sph_shim_cloud_range(s, first, last);
    memset(a, 0, sizeof a);
    memset(b, 0, sizeof b);
    memset(c, 0, sizeof c);
    memset(d, 0, sizeof d);
    memset(e, 0, sizeof e);
    memset(g, 0, sizeof g);
    CHECK(sph_shim_gradient_cspm(s, x.f, 1, a, c, e, status) ==
          sph_gradient_cspm(k, dim, part, cloud_f(&x),
                            (sph_derivatives_out){.gx = b, .gy = d, .gz = g, .status = status_inline}));
    CHECK(same((size_t)x.n, a, b, tolerance) && memcmp(status, status_inline, (size_t)x.n) == 0);
    if (dim > 1) CHECK(same((size_t)x.n, c, d, tolerance));
    if (dim > 2) CHECK(same((size_t)x.n, e, g, tolerance));
    CHECK(a[0] == 0 && a[last] == 0); /* out of the range: not touched */

    CHECK(sph_shim_laplacian_brookshaw(s, x.f, 1, a) ==
          sph_laplacian_brookshaw(k, dim, part, cloud_f(&x), sph_scalar_out_array(b, 0)));
    CHECK(same((size_t)x.n, a, b, tolerance));

    /* the components one by one: which stands where */
    memset(a, 0, sizeof a);
    CHECK(sph_shim_derivatives_icspm(s, x.f, 1, least, 1, a, status) >= 0);
    {
        sph_real *const component[] = {b, b + MAX_N, b + 2 * MAX_N, b + 3 * MAX_N, b + 4 * MAX_N, b + 5 * MAX_N, b + 6 * MAX_N, b + 7 * MAX_N, b + 8 * MAX_N};
        sph_index i;
        int q, p = 0;
        memset(b, 0, sizeof b);
        out.gx = component[p++];
        if (dim > 1) out.gy = component[p++];
        if (dim > 2) out.gz = component[p++];
        out.hxx = component[p++];
        if (dim > 1) out.hxy = component[p++], out.hyy = component[p++];
        if (dim > 2) out.hxz = component[p++], out.hyz = component[p++], out.hzz = component[p++];
        CHECK(p == numbers);
        CHECK(sph_derivatives_icspm(k, dim, part, cloud_f(&x), (sph_derivatives_options){.conditioning_min = least, .fallback_wls = 1}, out) >= 0);
        for (q = 0; q < numbers; q++) {
            for (i = 0; i < x.n; i++) c[i] = a[i * numbers + q];
            CHECK(same((size_t)x.n, c, component[q], BY_PRECISION(1e-9, 5e-2)));
        }
    }

    options.trace = 1;
    rows.row = other;
    rows.diagonal = d;
    rows.status = status_inline;
    memset(row, 0, sizeof row);
    memset(other, 0, sizeof other);
    CHECK(sph_shim_elliptic_rows_msph(s, x.V, 1, 1, row, c, status) ==
          sph_elliptic_rows_msph(k, dim, part, cloud_V(&x), options, rows));
    CHECK(same(found, row, other, tolerance) && same((size_t)x.n, c, d, tolerance) && memcmp(status, status_inline, (size_t)x.n) == 0);
    memset(a, 0, sizeof a);
    memset(b, 0, sizeof b);
    CHECK(sph_shim_rows_apply(s, row, c, x.f, 1, a) == sph_rows_apply(part, row, sph_scalars_array(c), cloud_f(&x), sph_scalar_out_array(b, 0)));
    CHECK(same((size_t)x.n, a, b, tolerance));

    /* collisions change both copies of the velocities alike */
    {
        const sph_real one = SPH_R(1);
        const sph_collision collision = {SPH_R(1.1) * (sph_real)x.dx, SPH_R(0.5), sph_scalars_same(&one)};
        sph_index i;
        for (i = 0; i < x.n; i++) {
            a[i] = b[i] = SPH_R(0.5) - x.x[i];
            c[i] = d[i] = SPH_R(0.5) - x.y[i];
            e[i] = g[i] = SPH_R(0.5) - x.z[i];
        }
        CHECK(sph_shim_collision_sequential(s, SPH_R(1.1) * (sph_real)x.dx, &one, 0, SPH_R(0.5), a, c, e, 1) == 0);
        CHECK(sph_collision_sequential(dim, part, collision, sph_vector_out_separate(b, d, g), 0) == 0);
        CHECK(same((size_t)x.n, a, b, tolerance));
        CHECK(fabs((double)a[first + 1] - (0.5 - (double)x.x[first + 1])) > 0);
    }

    /* periodic: an image of the first particle is a neighbour of the last */
    sph_shim_cloud_periodic(s, SPH_R(1.1), dim > 1 ? SPH_R(1.1) : SPH_R(0), SPH_R(0));
    sph_shim_cloud_range(s, 0, x.n);
    CHECK(sph_shim_density_summation(s, x.V, 1, b) == (radius > SPH_R(0.55) ? SPH_ERROR_BOX : 0));
    free(index);
    cloud_free(&x);
}

static void test_refusals(void)
{
    const sph_real x[] = {0, 1}, h = 1;
    const sph_index start[] = {0, 1, 2}, index[] = {1, 0};
    sph_real w = 1;
    sph_shim_cloud *const s = (sph_shim_cloud *)(void *)space;
    CHECK(sph_shim_version() == SPH_VERSION && sph_shim_real_size() == (int)sizeof(sph_real) && sph_shim_index_size() == (int)sizeof(sph_index));
    CHECK(sph_shim_kernel_from_name("no-such-kernel") == -1 && sph_shim_kernel_from_name(0) == -1);
    CHECK(!(sph_shim_kernel_support(-1) > 0) && sph_shim_kernel_support(SPH_QUINTIC_SPLINE) == SPH_R(3));
    CHECK(strcmp(sph_shim_status_text(SPH_ERROR_SELF), sph_status_text(SPH_ERROR_SELF)) == 0);
    CHECK(sph_shim_kernel_wf(-1, 1, 2, x, h, &w, 0) == SPH_ERROR_KERNEL && sph_shim_kernel_wf(SPH_KERNEL_COUNT, 1, 2, x, h, &w, 0) == SPH_ERROR_KERNEL);
    CHECK(sph_shim_kernel_wf(0, 0, 2, x, h, &w, 0) == SPH_ERROR_DIM && sph_shim_kernel_wf(0, 1, 2, 0, h, &w, 0) == SPH_ERROR_NULL);
    CHECK(sph_shim_kernel_wf(0, 1, 2, x, 0, &w, 0) == SPH_ERROR_H && w == SPH_R(1));
    CHECK(sph_shim_cloud_init(0, 0, 1, 2, x, 0, 0, 1) == SPH_ERROR_NULL && sph_shim_cloud_init(s, 0, 2, 2, x, 0, 0, 1) == SPH_ERROR_NULL);
    CHECK(sph_shim_cloud_init(s, 0, 4, 2, x, x, x, 1) == SPH_ERROR_DIM && sph_shim_cloud_init(s, 99, 1, 2, x, 0, 0, 1) == SPH_ERROR_KERNEL);
    CHECK(sph_shim_cloud_init(s, 0, 1, 2, x, 0, 0, 1) == 0);
    CHECK(sph_shim_density_summation(s, &h, 0, &w) == SPH_ERROR_NULL); /* no h, no lists yet */
    sph_shim_cloud_volumes(s, &h, 0, &h, 0);
    sph_shim_cloud_lists(s, start, index);
    {
        const sph_real bad[] = {1, -1};
        sph_index particle = 7;
        sph_shim_cloud_volumes(s, bad, 1, &h, 0);
        CHECK(sph_shim_cloud_check(s) == SPH_ERROR_H && sph_shim_density_summation(s, &h, 0, &w) == SPH_ERROR_H);
        CHECK(strcmp(sph_shim_refused(SPH_ERROR_NULL, &particle), "") == 0 && particle == -1); /* another error */
        CHECK(sph_shim_cloud_check(s) == SPH_ERROR_H);
        CHECK(strcmp(sph_shim_refused(SPH_ERROR_H, &particle), "h") == 0 && particle == 1);
        CHECK(strcmp(sph_shim_refused(SPH_ERROR_H, 0), "") == 0); /* told once */
        sph_shim_cloud_volumes(s, &h, 0, &h, 0);
        CHECK(sph_shim_cloud_check(s) == 0);
    }
    sph_shim_cloud_range(s, 0, 3);
    CHECK(sph_shim_density_summation(s, &h, 0, &w) == SPH_ERROR_RANGE && w == SPH_R(1));
    CHECK(sph_shim_derivatives_icspm(s, &h, 0, 0, 0, 0, 0) == SPH_ERROR_NULL && sph_shim_grid_lists(s, SPH_GATHER, 0, 0, 0, 0, 0, 0, 0, 0) == SPH_ERROR_NULL);
}

/* without particles all arrays may be null */
static void test_empty(void)
{
    sph_shim_cloud *const s = (sph_shim_cloud *)(void *)space;
    sph_index start[1] = {3};
    int64_t pairs = 3;
    CHECK(sph_shim_cloud_init(s, SPH_WENDLAND_C2, 2, 0, 0, 0, 0, 1) == 0);
    sph_shim_cloud_volumes(s, 0, 1, 0, 1);
    CHECK(sph_shim_grid_lists(s, SPH_GATHER, 0, 1, 0, 0, start, 0, 0, &pairs) == 0 && start[0] == 0 && pairs == 0);
    sph_shim_cloud_lists(s, start, 0);
    CHECK(sph_shim_cloud_check(s) == 0 && sph_shim_density_summation(s, 0, 1, 0) == 0);
    CHECK(sph_shim_gradient_cspm(s, 0, 1, 0, 0, 0, 0) == 0 && sph_shim_laplacian_brookshaw(s, 0, 1, 0) == 0);
    CHECK(sph_shim_derivatives_icspm(s, 0, 1, 0, 0, 0, 0) == 0);
    CHECK(sph_shim_elliptic_rows_msph(s, 0, 1, 0, 0, 0, 0) == 0 && sph_shim_rows_apply(s, 0, 0, 0, 1, 0) == 0);
    CHECK(sph_shim_collision_sequential(s, 1, 0, 1, 1, 0, 0, 0, 1) == 0);
}

int main(int argc, char **argv)
{
    int k, dim;
    test_known(argc > 1 ? argv[1] : "tests/known/kernels.csv");
    for (k = 0; k < (int)SPH_KERNEL_COUNT; k++)
        for (dim = 1; dim <= 3; dim++) test_cloud(k, dim);
    test_refusals();
    test_empty();
    return check_report("test_shim");
}
