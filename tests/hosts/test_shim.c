/* SPDX-License-Identifier: MIT */
/*
 * test_shim.c - the exported functions of examples/hosts/sph_shim.h, which are linked with: kernels against
 * the known answers, what is constant in the shim and what is not against the inline functions, everything
 * that takes a grid or memory of the caller's, and refusals. shim_calls.py calls all other operators.
 *
 *     test_shim [path of kernels.csv]
 */
#include "examples/hosts/known.h"
#include "examples/hosts/sph_shim.h"
#include "tests/check.h"
#include "tests/clouds.h"

enum { MAX_N = 512, MAX_PAIRS = 512 * 300 };
static sph_real a[MAX_N], b[MAX_N], row[MAX_PAIRS];
static unsigned char status[MAX_N], status_inline[MAX_N];
static double memory[MAX_PAIRS + MAX_N * 16];

/* The same sums, compiled twice: equal but for rounding. NaN is not. */
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

/* every kernel: those that are constants in the shim, and those that are not */
static void test_kernels(int kernel, int dim)
{
    const sph_kernel k = (sph_kernel)kernel;
    const int sides[] = {40, 14, 7};
    const double tolerance = BY_PRECISION(1e-11, 2e-3);
    cloud x = cloud_lattice(dim, sides[dim - 1], 1.3, 0.2, 7);
    const sph_points points = cloud_points(&x);
    const sph_real support = sph_kernel_support_ratio(k) * x.h;
    const sph_scalars radius = sph_scalars_same(&support), f = cloud_f(&x), V = cloud_V(&x);
    const size_t size = sph_shim_search_size(dim, x.n, MAX_PAIRS);
    sph_neighbors found;
    sph_cloud c;
    sph_scalar_out out = sph_scalar_out_array(a, status);
    sph_derivatives_out gradient = {0};
    cloud_set(&x, field_smooth);
    CHECK(x.n <= MAX_N && size <= sizeof memory);
    CHECK(sph_shim_search(dim, &points, &radius, SPH_GATHER, memory, 8, &found) == SPH_ERROR_CAPACITY);
    CHECK(found.pairs > x.n && found.pairs <= MAX_PAIRS);
    CHECK(sph_shim_search(dim, &points, &radius, SPH_GATHER, memory, size, &found) == 0);
    CHECK(found.pairs == found.list.start[x.n]);
    c = sph_cloud_of(points, found.list, cloud_h(&x), V);
    CHECK(sph_shim_cloud_checked(dim, &c) == 0 && c.checked == 1);
    CHECK(sph_shim_density_summation(kernel, dim, &c, &V, &out) ==
          sph_density_summation(k, dim, c, V, sph_scalar_out_array(b, status_inline)));
    CHECK(same((size_t)x.n, a, b, tolerance) && memcmp(status, status_inline, (size_t)x.n) == 0);

    sph_shim_cloud_range(&c, x.n / 4, x.n - 1);
    CHECK(c.checked == 1 && c.first == x.n / 4 && c.last == x.n - 1);
    memset(a, 0, sizeof a);
    memset(b, 0, sizeof b);
    gradient.gx = a;
    gradient.gy = gradient.gz = row;
    gradient.status = status;
    CHECK(sph_shim_gradient_cspm(kernel, dim, &c, &f, &gradient) == 0);
    gradient.gx = b;
    gradient.status = status_inline;
    CHECK(sph_gradient_cspm(k, dim, c, f, gradient) == 0);
    CHECK(same((size_t)x.n, a, b, tolerance) && memcmp(status, status_inline, (size_t)x.n) == 0);
    CHECK(a[0] == 0 && a[x.n - 1] == 0); /* out of the range: not touched */
    cloud_free(&x);
}

/* what takes a grid, or memory of the caller's */
static void test_memory(int dim)
{
    const int sides[] = {40, 14, 7};
    cloud x = cloud_lattice(dim, sides[dim - 1], 1.3, 0.2, 7);
    const sph_points points = cloud_points(&x);
    const sph_real support = SPH_R(2) * x.h;
    const sph_scalars radius = sph_scalars_same(&support), V = cloud_V(&x);
    const sph_query query = sph_query_of(points, SPH_GATHER, radius, 0);
    static sph_index start[MAX_N + 1], start_inline[MAX_N + 1], index[MAX_PAIRS], index_inline[MAX_PAIRS],
        order[MAX_N];
    static double work[MAX_N * 16];
    sph_csr csr = {0}, csr_inline = {0};
    static sph_index csr_start[2][MAX_N + 1], csr_column[2][MAX_PAIRS + MAX_N];
    static sph_real csr_value[2][MAX_PAIRS + MAX_N];
    sph_findings findings, findings_inline;
    sph_points moved = points;
    sph_grid grid;
    sph_list list;
    sph_cloud c;
    int64_t pairs, pairs_inline, entries, entries_inline;
    sph_index i;
    cloud_set(&x, field_smooth);
    CHECK(sph_shim_grid_workspace(dim, x.n) == sph_grid_workspace(dim, x.n) && sizeof work >= sph_grid_workspace(dim, x.n));
    CHECK(sph_shim_grid_build(dim, &points, &radius, work, sizeof work, &grid) == 0);
    CHECK(sph_shim_grid_count(dim, &grid, &query, start, &pairs) == 0 && sph_grid_count(dim, &grid, query, start_inline, &pairs_inline) == 0);
    CHECK(pairs == pairs_inline && pairs > x.n && pairs <= MAX_PAIRS && memcmp(start, start_inline, ((size_t)x.n + 1) * sizeof *start) == 0);
    CHECK(sph_shim_grid_lists(dim, &grid, &query, start, index, 1, &pairs) == SPH_ERROR_CAPACITY && pairs == pairs_inline);
    CHECK(sph_shim_grid_lists(dim, &grid, &query, start, index, MAX_PAIRS, &pairs) == 0);
    CHECK(sph_grid_lists(dim, &grid, query, start_inline, index_inline, MAX_PAIRS, &pairs_inline) == 0);
    CHECK(pairs == pairs_inline && memcmp(index, index_inline, (size_t)pairs * sizeof *index) == 0);
    CHECK(sph_shim_grid_permutation(&grid) == sph_grid_permutation(&grid) && sph_shim_grid_permutation(0) == 0);
    CHECK(sph_shim_permute(x.n, sph_shim_grid_permutation(&grid), x.f, 1, a) == 0 && sph_permute(x.n, sph_grid_permutation(&grid), x.f, 1, b) == 0);
    CHECK(same((size_t)x.n, a, b, 0));
    CHECK(sph_shim_permute_inverse(x.n, sph_shim_grid_permutation(&grid), order) == 0);
    for (i = 0; i < x.n; i++)
        if (order[sph_grid_permutation(&grid)[i]] != i) break;
    CHECK(i == x.n);

    list.start = start;
    list.index = index;
    c = sph_cloud_of(points, list, cloud_h(&x), cloud_V(&x));
    for (i = 0; i < (sph_index)pairs; i++) row[i] = SPH_R(i % 3);
    CHECK(sph_shim_csr_size(&c) == sph_csr_size(c) && sph_csr_size(c) == pairs + x.n);
    csr.start = csr_start[0];
    csr.column = csr_column[0];
    csr.value = csr_value[0];
    csr_inline.start = csr_start[1];
    csr_inline.column = csr_column[1];
    csr_inline.value = csr_value[1];
    csr.capacity = csr_inline.capacity = MAX_PAIRS + MAX_N;
    CHECK(sph_shim_csr_assemble(&c, row, &V, 1, &csr, &entries) == 0 && sph_csr_assemble(c, row, V, 1, csr_inline, &entries_inline) == 0);
    CHECK(entries == entries_inline && entries < pairs && memcmp(csr_column[0], csr_column[1], (size_t)entries * sizeof **csr_column) == 0);
    CHECK(same((size_t)entries, csr_value[0], csr_value[1], 0));

    CHECK(sph_shim_cloud_examine(SPH_CUBIC_SPLINE, dim, &c, 0, 20, &findings) == sph_cloud_examine(SPH_CUBIC_SPLINE, dim, c, 0, 20, &findings_inline));
    CHECK(findings.set == findings_inline.set && findings.sampled == findings_inline.sampled && findings.sampled > 0);
    CHECK(strcmp(sph_shim_finding_text(SPH_FINDING_BOX), sph_finding_text(SPH_FINDING_BOX)) == 0);
    CHECK(sph_shim_rebuild_due(dim, &points, &moved, SPH_R(0.1)) == 0);
    for (i = 0; i < x.n; i++) a[i] = x.x[i] + SPH_R(0.2);
    moved.x = a;
    moved.stride = 1;
    if (points.stride == 1) CHECK(sph_shim_rebuild_due(dim, &points, &moved, SPH_R(0.1)) == 1);
    CHECK(sph_shim_grid_renumber(&grid) == 0 && sph_shim_grid_permutation(&grid)[x.n - 1] == x.n - 1);
    cloud_free(&x);
}

static void test_refusals(void)
{
    const sph_real x[] = {0, 1}, one = 1, bad[] = {1, -1};
    const sph_index start[] = {0, 1, 2}, index[] = {1, 0};
    const sph_list list = {start, index};
    const sph_scalars same_one = {&one, 0}, worse = {bad, 1};
    const sph_points points = sph_points_strided(2, x, 0, 0, 1);
    sph_cloud c = sph_cloud_of(points, list, same_one, same_one);
    sph_index particle = 7;
    sph_real w[2] = {1, 1};
    sph_scalar_out out = {0};
    out.p = w;
    CHECK(sph_shim_version() == SPH_VERSION && sph_shim_real_size() == (int)sizeof(sph_real) && sph_shim_index_size() == (int)sizeof(sph_index));
    CHECK(sph_shim_struct_size("sph_cloud") == sizeof(sph_cloud) && sph_shim_struct_size("sph_mhd") == sizeof(sph_mhd));
    CHECK(sph_shim_struct_size("sph_none") == 0 && sph_shim_struct_size(0) == 0);
    CHECK(sph_shim_kernel_from_name("no-such-kernel") == -1 && sph_shim_kernel_from_name(0) == -1);
    CHECK(strcmp(sph_shim_kernel_name(SPH_WENDLAND_C2), "wendland-c2") == 0);
    CHECK(!(sph_shim_kernel_support_ratio(-1) > 0) && sph_shim_kernel_support_ratio(SPH_QUINTIC_SPLINE) == SPH_R(3));
    CHECK(strcmp(sph_shim_status_text(SPH_ERROR_SELF), sph_status_text(SPH_ERROR_SELF)) == 0);
    CHECK(!(sph_shim_kernel_w(0, 4, 0, 1) > 0) && !(sph_shim_kernel_w(-1, 1, 0, 1) > 0) && sph_shim_kernel_w(0, 1, 0, 1) > 0);
    CHECK(sph_shim_kernel_wf(-1, 1, 2, x, one, w, 0) == SPH_ERROR_KERNEL && sph_shim_kernel_wf(SPH_KERNEL_COUNT, 1, 2, x, one, w, 0) == SPH_ERROR_KERNEL);
    CHECK(sph_shim_kernel_wf(0, 0, 2, x, one, w, 0) == SPH_ERROR_DIM && sph_shim_kernel_wf(0, 1, 2, 0, one, w, 0) == SPH_ERROR_NULL);
    CHECK(sph_shim_kernel_wf(0, 1, 2, x, 0, w, 0) == SPH_ERROR_H && w[0] == SPH_R(1));

    /* kernels and dimensions that there are not, for a sweep with constant kernels and for one without */
    CHECK(sph_shim_density_summation(-1, 1, &c, &same_one, &out) == SPH_ERROR_KERNEL && sph_shim_shepard_sum(99, 1, &c, &out) == SPH_ERROR_KERNEL);
    CHECK(sph_shim_density_summation(0, 4, &c, &same_one, &out) == SPH_ERROR_DIM && sph_shim_shepard_sum(0, 0, &c, &out) == SPH_ERROR_DIM);
    CHECK(strcmp(sph_shim_refused(SPH_ERROR_DIM, &particle), "dim") == 0 && particle == -1);
    CHECK(sph_shim_grid_build(7, &points, &same_one, 0, 0, 0) == SPH_ERROR_DIM);

    /* structs that are not there: of those that count particles an error, of all others zeros */
    CHECK(sph_shim_density_summation(0, 1, 0, &same_one, &out) == SPH_ERROR_NULL && sph_shim_cloud_checked(1, 0) == SPH_ERROR_NULL);
    CHECK(strcmp(sph_shim_refused(SPH_ERROR_NULL, 0), "cloud") == 0);
    CHECK(sph_shim_search(1, 0, &same_one, SPH_GATHER, 0, 0, 0) == SPH_ERROR_NULL && sph_shim_csr_size(0) == SPH_ERROR_NULL);
    CHECK(sph_shim_density_summation(0, 1, &c, 0, &out) == SPH_ERROR_NULL && sph_shim_density_summation(0, 1, &c, &same_one, 0) == SPH_ERROR_NULL);
    CHECK(w[0] == SPH_R(1) && w[1] == SPH_R(1));
    CHECK(sph_shim_density_summation(0, 1, &c, &same_one, &out) == 0 && w[0] > SPH_R(0.5));

    c.h = worse;
    CHECK(sph_shim_cloud_checked(1, &c) == SPH_ERROR_H && sph_shim_density_summation(0, 1, &c, &same_one, &out) == SPH_ERROR_H);
    CHECK(strcmp(sph_shim_refused(SPH_ERROR_NULL, &particle), "") == 0 && particle == -1); /* another error */
    CHECK(sph_shim_cloud_checked(1, &c) == SPH_ERROR_H);
    CHECK(strcmp(sph_shim_refused(SPH_ERROR_H, &particle), "h") == 0 && particle == 1);
    CHECK(strcmp(sph_shim_refused(SPH_ERROR_H, 0), "") == 0); /* told once */
    c.h = same_one;
    sph_shim_cloud_range(&c, 0, 3);
    CHECK(c.checked == 0 && sph_shim_density_summation(0, 1, &c, &same_one, &out) == SPH_ERROR_RANGE);
}

/* without particles all arrays may be null, and structs as well */
static void test_empty(void)
{
    const sph_points nothing = {0};
    sph_cloud c = {0};
    sph_neighbors found;
    sph_index start[1] = {3};
    c.list.start = start;
    CHECK(sph_shim_search(2, &nothing, 0, SPH_GATHER, memory, sph_shim_search_size(2, 0, 0), &found) == 0 && found.pairs == 0);
    c.list = found.list;
    CHECK(sph_shim_cloud_checked(2, &c) == 0 && sph_shim_density_summation(0, 2, &c, 0, 0) == 0);
    CHECK(sph_shim_gradient_cspm(SPH_WENDLAND_C4, 2, &c, 0, 0) == 0 && sph_shim_fluid_rates_monaghan(0, 3, &c, 0, 0) == 0);
    CHECK(sph_shim_rows_apply(&c, 0, 0, 0, 0) == 0);
}

int main(int argc, char **argv)
{
    int k, dim;
    test_known(argc > 1 ? argv[1] : "tests/known/kernels.csv");
    for (dim = 1; dim <= 3; dim++) {
        for (k = 0; k < (int)SPH_KERNEL_COUNT; k++) test_kernels(k, dim);
        test_memory(dim);
    }
    test_refusals();
    test_empty();
    return check_report("test_shim");
}
