/* SPDX-License-Identifier: MIT */
/*
 * test_fits.c - values and gradients at points that are no particles (moving least squares, Liu & Liu), and what walls make of them: mirror points (mDBC),
 * mirror particles, and the rows of walls in a matrix for pressures.
 *
 * Linear fields come out exactly, in the cloud and outside of it, where Shepard's mean is off by two or three spacings; rows say the same as the sweeps; where the
 * neighbours are too few or lie on a line the fallback is Shepard's mean. A column of water at rest, solved with the rows of walls, has its weight as its pressure.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#define KERNEL SPH_WENDLAND_C2
enum { MLS, LIU, FITS };
static const char *const fit_name[FITS] = {"mls", "liu"};
#define IN_DIM(dim, call) ((dim) == 1 ? call(1) : (dim) == 2 ? call(2) : call(3))

/* Probes, the lists of their neighbours among the particles of a cloud, and what is found there. */
typedef struct probes {
    sph_index n;
    sph_real *x[3], *h, *value, *g[3], *conditioning, *row[4];
    unsigned char *status;
    sph_index *start, *index;
} probes;
static probes probes_new(sph_index n)
{
    probes p = {0};
    p.n = n;
    for (int a = 0; a < 3; a++) {
        p.x[a] = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
        p.g[a] = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
    }
    p.h = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
    p.value = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
    p.conditioning = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
    p.status = (unsigned char *)cloud_memory((size_t)n, 1);
    p.start = (sph_index *)cloud_memory((size_t)n + 1, sizeof(sph_index));
    return p;
}
static sph_points probe_points(const probes *p) { return sph_points_separate(p->n, p->x[0], p->x[1], p->x[2]); }
static void probes_find(probes *p, int dim, sph_points particles, double radius)
{
    const size_t size = sph_grid_workspace(dim, particles.n);
    void *const work = cloud_memory(size, 1);
    const sph_real reach = SPH_R(radius);
    const sph_scalars R = sph_scalars_same(&reach);
    const sph_query query = sph_query_of(probe_points(p), SPH_GATHER, R, SPH_LIST_FOREIGN);
    sph_grid g;
    int64_t pairs;
    if (sph_grid_build(dim, particles, R, work, size, &g) != 0 || sph_grid_count(dim, &g, query, p->start, &pairs) != 0) abort();
    free(p->index);
    p->index = (sph_index *)cloud_memory((size_t)pairs, sizeof(sph_index));
    if (sph_grid_lists(dim, &g, query, p->start, p->index, pairs, &pairs) != 0) abort();
    for (int a = 0; a < 4; a++) {
        free(p->row[a]);
        p->row[a] = (sph_real *)cloud_memory((size_t)pairs, sizeof(sph_real));
    }
    free(work);
}
static void probes_free(probes *p)
{
    for (int a = 0; a < 3; a++) free(p->x[a]), free(p->g[a]);
    for (int a = 0; a < 4; a++) free(p->row[a]);
    free(p->h), free(p->value), free(p->conditioning), free(p->status), free(p->start), free(p->index);
}
static sph_index fit(int method, int dim, probes *p, sph_points particles, sph_scalars V, sph_scalars f, double least)
{
    const sph_list list = {p->start, p->index};
    const sph_cloud at = sph_cloud_of(probe_points(p), list, sph_scalars_array(p->h), sph_scalars_none());
    const sph_sources from = {particles, V};
    const sph_interpolation_options o = {SPH_R(least)};
    const sph_interpolation_out out = {p->value, p->g[0], p->g[1], p->g[2], p->conditioning, 1, p->status};
#define MLS_IN(D) sph_interpolate_mls(KERNEL, D, at, from, f, o, out)
#define LIU_IN(D) sph_interpolate_liu(KERNEL, D, at, from, f, o, out)
    return method == MLS ? IN_DIM(dim, MLS_IN) : IN_DIM(dim, LIU_IN);
}
static sph_index fit_rows(int method, int dim, probes *p, sph_points particles, sph_scalars V, double least)
{
    const sph_list list = {p->start, p->index};
    const sph_cloud at = sph_cloud_of(probe_points(p), list, sph_scalars_array(p->h), sph_scalars_none());
    const sph_sources from = {particles, V};
    const sph_interpolation_options o = {SPH_R(least)};
    const sph_interpolation_rows_out out = {p->row[0], p->row[1], p->row[2], p->row[3], p->conditioning, 1, p->status};
#define MLS_ROWS(D) sph_interpolate_rows_mls(KERNEL, D, at, from, o, out)
#define LIU_ROWS(D) sph_interpolate_rows_liu(KERNEL, D, at, from, o, out)
    return method == MLS ? IN_DIM(dim, MLS_ROWS) : IN_DIM(dim, LIU_ROWS);
}
static double shepard(const cloud *c, const probes *p, sph_index i)
{
    double sum = 0.0, weight = 0.0;
    for (sph_index q = p->start[i]; q < p->start[i + 1]; q++) {
        const sph_index j = p->index[q];
        const double d[3] = {(double)c->x[j] - (double)p->x[0][i], (double)c->y[j] - (double)p->x[1][i], (double)c->z[j] - (double)p->x[2][i]};
        const double w = (double)c->V[j] * (double)sph_kernel_w(KERNEL, c->dim, SPH_R(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])), p->h[i]);
        sum += w * (double)c->f[j], weight += w;
    }
    return weight > 0.0 ? sum / weight : 0.0;
}
/* in the cloud, near its edge, and up to a spacing and a half outside; h of each probe, any volumes */
static void test_linear(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, dim == 1 ? 60 : dim == 2 ? 20 : 10, 1.6, 0.3, 5);
        probes p = probes_new(300);
        pcg32 g;
        pcg32_seed(&g, 8, 8);
        cloud_random_volumes(&c, 3);
        cloud_set(&c, field_linear);
        for (sph_index i = 0; i < p.n; i++) {
            for (int a = 0; a < dim; a++) p.x[a][i] = SPH_R(-1.5 * c.dx + (1.0 + 3.0 * c.dx) * pcg32_uniform(&g));
            p.h[i] = c.h * SPH_R(1.0 + 0.4 * pcg32_uniform(&g));
        }
        probes_find(&p, dim, cloud_points(&c), 2.0 * 1.4 * (double)c.h);
        for (int method = 0; method < (int)FITS; method++) {
            double value = 0.0, gradient = 0.0, mean = 0.0, row = 0.0, sum = 0.0;
            CHECK(fit(method, dim, &p, cloud_points(&c), cloud_V(&c), cloud_f(&c), 0.0) >= 0);
            CHECK(fit_rows(method, dim, &p, cloud_points(&c), cloud_V(&c), 0.0) >= 0);
            for (sph_index i = 0; i < p.n; i++) {
                double x[3] = {(double)p.x[0][i], (double)p.x[1][i], (double)p.x[2][i]}, d[COMPONENTS], by_row[4] = {0}, sums[4] = {0};
                const double exact = field_linear(x, d), good = fmin(1.0, (double)p.conditioning[i]);
                for (sph_index q = p.start[i]; q < p.start[i + 1]; q++)
                    for (int a = 0; a <= dim; a++) by_row[a] += (double)p.row[a][q] * (double)c.f[p.index[q]], sums[a] += (double)p.row[a][q];
                row = fmax(row, fabs(by_row[0] - (double)p.value[i]) * good);
                sum = fmax(sum, fabs(sums[0] - (p.status[i] != SPH_TOO_FEW)));
                for (int a = 0; a < dim; a++) row = fmax(row, fabs(by_row[1 + a] - (double)p.g[a][i]) * c.dx * good), sum = fmax(sum, fabs(sums[1 + a]) * c.dx * good);
                if (p.status[i] != SPH_OK) continue;
                value = fmax(value, fabs((double)p.value[i] - exact) * good);
                for (int a = 0; a < dim; a++) gradient = fmax(gradient, fabs((double)p.g[a][i] - d[a]) * c.dx * good);
                mean = fmax(mean, fabs(shepard(&c, &p, i) - exact));
            }
            CHECK_WORST(check_words("%s in %dD: value of a linear field", fit_name[method], dim), value, BY_PRECISION(1e-12, 1e-5));
            CHECK_WORST(check_words("%s in %dD: gradient of a linear field, times dx", fit_name[method], dim), gradient, BY_PRECISION(1e-12, 1e-5));
            CHECK_WORST(check_words("%s in %dD: rows against the sweep", fit_name[method], dim), row, BY_PRECISION(1e-12, 1e-5));
            CHECK_WORST(check_words("%s in %dD: sums of rows", fit_name[method], dim), sum, BY_PRECISION(1e-12, 1e-5));
            CHECK(mean > c.dx); /* Shepard's mean is not exact */
        }
        probes_free(&p);
        cloud_free(&c);
    }
}
/* A constant comes out to the last bit, far from 0, too; the error of a smooth field is of second order. */
static void test_order(void)
{
    static const double constant = 12345.678;
    for (int method = 0; method < (int)FITS; method++) {
        double off[2] = {0};
        for (int fine = 0; fine < 2; fine++) {
            cloud c = cloud_lattice(2, 20 << fine, 1.6, 0.2, 5);
            probes p = probes_new(200);
            pcg32 g;
            pcg32_seed(&g, 4, 4);
            for (sph_index i = 0; i < p.n; i++) p.x[0][i] = SPH_R(pcg32_uniform(&g)), p.x[1][i] = SPH_R(pcg32_uniform(&g)), p.h[i] = c.h;
            probes_find(&p, 2, cloud_points(&c), 2.0 * (double)c.h);
            for (sph_index i = 0; i < c.n; i++) c.f[i] = SPH_R(constant);
            CHECK(fit(method, 2, &p, cloud_points(&c), cloud_V(&c), cloud_f(&c), 0.0) == 0);
            for (sph_index i = 0; i < p.n; i++) CHECK_AT("a constant, to the last bit", i, p.value[i] == SPH_R(constant) && p.g[0][i] == SPH_R(0));
            cloud_set(&c, field_smooth);
            CHECK(fit(method, 2, &p, cloud_points(&c), cloud_V(&c), cloud_f(&c), 0.0) == 0);
            for (sph_index i = 0; i < p.n; i++) {
                const double x[3] = {(double)p.x[0][i], (double)p.x[1][i], 0.0}, e = (double)p.value[i] - field_smooth(x, 0);
                off[fine] += e * e;
            }
            probes_free(&p);
            cloud_free(&c);
        }
        CHECK_NEAR(check_words("%s: order of the value", fit_name[method]), 0, 0.5 * log2(off[0] / off[1]), 2.0, 0.25);
    }
}
/* Few neighbours, neighbours on a line, none, a limit to the conditioning, sources without volume. */
static void test_fallback(void)
{
    for (int method = 0; method < (int)FITS; method++)
        for (int what = 0; what < 5; what++) {
            cloud c = cloud_new(2, 6);
            probes p = probes_new(1);
            double least = 0.0;
            for (sph_index i = 0; i < c.n; i++) {
                c.x[i] = SPH_R(0.1 * (double)i), c.y[i] = what == 1 ? SPH_R(0.05 * (double)i) : SPH_R(0.1 * (double)(i * i % 5)), c.V[i] = SPH_R(1.0 + 0.1 * (double)i);
                c.f[i] = SPH_R(3.0 + 2.0 * (double)c.x[i] - (double)c.y[i]);
                if (what == 0 && i > 1) c.x[i] += SPH_R(5);  /* two neighbours */
                if (what == 2) c.x[i] += SPH_R(5);           /* none */
                if (what == 3) least = 2.0;                  /* nothing is that good */
                if (what == 4 && i > 1) c.V[i] = SPH_R(0);   /* the others do not count */
            }
            p.x[0][0] = SPH_R(0.12), p.x[1][0] = SPH_R(0.13), p.h[0] = SPH_R(0.5);
            probes_find(&p, 2, cloud_points(&c), 1.0);
            CHECK(fit(method, 2, &p, cloud_points(&c), cloud_V(&c), cloud_f(&c), least) == 1);
            CHECK_SAME("status", what, p.status[0], what == 2 ? SPH_TOO_FEW : SPH_FELL_BACK);
            CHECK_CLOSE((double)p.value[0], shepard(&c, &p, 0), BY_PRECISION(1e-14, 1e-6));
            CHECK(p.g[0][0] == SPH_R(0) && p.g[1][0] == SPH_R(0));
            CHECK(fit_rows(method, 2, &p, cloud_points(&c), cloud_V(&c), least) == 1);
            {
                double sum = 0.0;
                for (sph_index q = p.start[0]; q < p.start[1]; q++) sum += (double)p.row[0][q] * (double)c.f[p.index[q]], CHECK(p.row[1][q] == SPH_R(0) && p.row[2][q] == SPH_R(0));
                CHECK_CLOSE(sum, (double)p.value[0], BY_PRECISION(1e-14, 1e-6));
            }
            probes_free(&p);
            cloud_free(&c);
        }
}
/* Periodic: a probe that is moved by the lengths of the box finds the same. */
static void test_periodic(void)
{
    cloud c = cloud_lattice(2, 20, 1.6, 0.2, 5);
    const sph_points x = sph_points_periodic(cloud_points(&c), SPH_R(1 + c.dx), SPH_R(1 + c.dx), SPH_R(0));
    probes p = probes_new(2);
    cloud_set(&c, field_smooth);
    p.x[0][0] = SPH_R(-0.01), p.x[1][0] = SPH_R(0.3), p.h[0] = p.h[1] = c.h;
    p.x[0][1] = p.x[0][0] + SPH_R(1 + c.dx), p.x[1][1] = p.x[1][0] - SPH_R(1 + c.dx);
    probes_find(&p, 2, x, 2.0 * (double)c.h);
    CHECK(p.start[1] > 8 && p.start[2] == 2 * p.start[1]);
    for (int method = 0; method < (int)FITS; method++) {
        CHECK(fit(method, 2, &p, x, cloud_V(&c), cloud_f(&c), 0.0) == 0);
        CHECK_CLOSE((double)p.value[0], (double)p.value[1], BY_PRECISION(1e-13, 1e-5));
        CHECK_CLOSE((double)p.g[1][0], (double)p.g[1][1], BY_PRECISION(1e-12, 1e-4));
    }
    probes_free(&p);
    cloud_free(&c);
}

/* ---------------------------------------------------------------- walls */

/* mDBC: wall particles below y = 0, mirrored into the fluid above; their pressure is that of the fluid extended. A pressure of any gradient, where Adami's is for gravity alone. */
static void test_mirror(void)
{
    cloud c = cloud_lattice(2, 20, 1.6, 0.3, 5);
    const sph_vec at = {SPH_R(0.3), SPH_R(0), SPH_R(0)}, normal = {SPH_R(0), SPH_R(3), SPH_R(0)};
    probes wall = probes_new(14), mirror = probes_new(14);
    cloud_set(&c, field_linear);
    for (sph_index i = 0; i < wall.n; i++) {
        sph_vec x = {SPH_R(0.2 + 0.04 * (double)i), SPH_R(-(0.5 + (double)(i % 3)) * c.dx), SPH_R(0)}, m;
        m = sph_wall_mirror(2, x, at, normal);
        CHECK_CLOSE((double)m.x, (double)x.x, 0.0);
        CHECK_CLOSE((double)m.y, -(double)x.y, BY_PRECISION(1e-16, 1e-8));
        x = sph_wall_mirror(2, m, at, normal); /* twice is not at all */
        wall.x[0][i] = x.x, wall.x[1][i] = x.y, mirror.x[0][i] = m.x, mirror.x[1][i] = m.y;
        wall.h[i] = mirror.h[i] = c.h;
    }
    probes_find(&mirror, 2, cloud_points(&c), 2.0 * (double)c.h);
    probes_find(&wall, 2, cloud_points(&c), 2.0 * (double)c.h);
    for (int method = 0; method < (int)FITS; method++) {
        double off = 0.0, mean = 0.0;
        CHECK(fit(method, 2, &mirror, cloud_points(&c), cloud_V(&c), cloud_f(&c), 1e-3) == 0);
        for (sph_index i = 0; i < wall.n; i++) {
            const sph_vec gradient = {mirror.g[0][i], mirror.g[1][i], SPH_R(0)}, away = {wall.x[0][i] - mirror.x[0][i], wall.x[1][i] - mirror.x[1][i], SPH_R(0)};
            const double x[3] = {(double)wall.x[0][i], (double)wall.x[1][i], 0.0}, exact = field_linear(x, 0);
            off = fmax(off, fabs((double)sph_fit_extend(2, mirror.value[i], gradient, away) - exact));
            if (wall.start[i + 1] > wall.start[i] && shepard(&c, &wall, i) != 0.0) mean = fmax(mean, fabs(shepard(&c, &wall, i) - exact));
        }
        CHECK_WORST(check_words("mDBC by %s: a linear pressure at the wall", fit_name[method]), off, BY_PRECISION(1e-13, 1e-5));
        CHECK(mean > 0.5 * c.dx); /* without gradient it is not */
    }
    /* a plane of any direction: the image of a velocity is that of free slip; the pressure of a mirror particle is that of its fluid particle, and gravity */
    {
        const sph_vec n = {SPH_R(1), SPH_R(2), SPH_R(-1)}, x = {SPH_R(0.3), SPH_R(0.1), SPH_R(0.7)}, p0 = {SPH_R(0.2), SPH_R(0), SPH_R(0.1)}, nothing = {0, 0, 0};
        const sph_vec m = sph_wall_mirror(3, x, p0, n), v = sph_wall_velocity_free_slip(3, x, p0, n), middle = {SPH_R(0.5) * (x.x + m.x), SPH_R(0.5) * (x.y + m.y), SPH_R(0.5) * (x.z + m.z)};
        const sph_fluid_side j = {SPH_R(1), SPH_R(1.2), SPH_R(4), SPH_R(0)};
        const sph_vec gravity = {SPH_R(0), SPH_R(-9.81), SPH_R(0)};
        CHECK(m.x == v.x && m.y == v.y && m.z == v.z);
        CHECK_CLOSE((double)sph_dot(3, sph_subtract(3, middle, p0), n), 0.0, BY_PRECISION(1e-15, 1e-6));
        CHECK_CLOSE((double)sph_wall_pair_adami(3, j, nothing, sph_subtract(3, m, x), gravity, SPH_R(1)).p, 4.0 - 1.2 * 9.81 * ((double)m.y - (double)x.y), BY_PRECISION(1e-14, 1e-5));
        CHECK(sph_wall_mirror(3, x, p0, nothing).y == x.y);
    }
    probes_free(&wall), probes_free(&mirror);
    cloud_free(&c);
}

enum { MSPH, WLS, BROOKSHAW, SCHEMES };
static const char *const scheme_name[SCHEMES] = {"msph", "wls", "brookshaw"};
static void eliminate(int n, double *a, double *b) /* dense, with pivoting: b becomes the solution */
{
    for (int c = 0; c < n; c++) {
        int best = c;
        for (int i = c + 1; i < n; i++)
            if (fabs(a[i * n + c]) > fabs(a[best * n + c])) best = i;
        for (int j = 0; j < n && best != c; j++) {
            const double t = a[c * n + j];
            a[c * n + j] = a[best * n + j], a[best * n + j] = t;
        }
        if (best != c) {
            const double t = b[c];
            b[c] = b[best], b[best] = t;
        }
        for (int i = c + 1; i < n; i++) {
            const double m = a[i * n + c] / a[c * n + c];
            if (m == 0.0) continue;
            for (int j = c; j < n; j++) a[i * n + j] -= m * a[c * n + j];
            b[i] -= m * b[c];
        }
    }
    for (int c = n - 1; c >= 0; c--) {
        for (int j = c + 1; j < n; j++) b[c] -= a[c * n + j] * b[j];
        b[c] /= a[c * n + c];
    }
}
/* Water at rest on a floor of three layers of wall particles, periodic sideways, with p given in its upmost layer: lap p = 0 with rows of the wall (kept = 1), or with the wall
   eliminated (kept = 0), must give p = rho g (H - y). The largest error / rho g H. */
static double still_water(int scheme, int kept, double jitter)
{
    enum { SIDE = 12, LAYERS = 3, WET = SIDE * SIDE, ALL = SIDE * (SIDE + LAYERS) };
    static const sph_real rho_value = SPH_R(1.5), one = 1;
    const double dx = 1.0 / SIDE, g = 9.0;
    cloud c = cloud_new(2, ALL);
    sph_real share[ALL], rhs[ALL], diagonal[ALL];
    unsigned char status[ALL];
    double *const a = (double *)cloud_memory((size_t)ALL * ALL, sizeof *a), *const b = (double *)cloud_memory(ALL, sizeof *b), worst = 0.0;
    sph_neighbors found;
    sph_wall wall = {0};
    sph_rows_out out = {0};
    sph_elliptic_options o = {0};
    sph_points x;
    sph_cloud all, wet, walls;
    void *memory = 0;
    size_t size = 0;
    pcg32 random;
    sph_real radius;
    pcg32_seed(&random, 6, 6);
    c.h = SPH_R(1.6 * dx);
    radius = SPH_R(2.0 * 1.6 * dx);
    for (sph_index i = 0; i < ALL; i++) {
        const double up = i < WET ? (double)(i / SIDE) : -1.0 - (double)((i - WET) / SIDE), shake = i < WET ? jitter : 0.0;
        c.x[i] = SPH_R(((double)(i % SIDE) + 0.5 + shake * cloud_symmetric(&random)) * dx);
        c.y[i] = SPH_R((up + 0.5 + shake * cloud_symmetric(&random)) * dx);
        c.V[i] = SPH_R(dx * dx);
        share[i] = SPH_R(i < WET);
        rhs[i] = diagonal[i] = SPH_R(0);
    }
    x = sph_points_periodic(cloud_points(&c), SPH_R(1), SPH_R(0), SPH_R(0));
    while (sph_search(2, x, sph_scalars_same(&radius), SPH_GATHER, memory, size, &found) == SPH_ERROR_CAPACITY) memory = realloc(memory, size = sph_search_size(2, ALL, found.pairs));
    all = sph_cloud_of(x, found.list, cloud_h(&c), cloud_V(&c));
    wet = sph_cloud_range(all, 0, WET), walls = sph_cloud_range(all, WET, ALL);
    wall.share = sph_scalars_array(share);
    wall.rho = sph_scalars_same(&rho_value);
    wall.gravity.y = SPH_R(-g);
    out.row = (sph_real *)cloud_memory((size_t)found.pairs, sizeof(sph_real));
    out.diagonal = diagonal;
    out.status = status;
    if (scheme == MSPH) CHECK(sph_elliptic_rows_msph(KERNEL, 2, wet, sph_scalars_same(&one), o, out) == 0);
    else if (scheme == WLS) CHECK(sph_derivatives_rows_wls(KERNEL, 2, wet, sph_jet_laplacian(2), out) == 0);
    else CHECK(sph_laplacian_rows_brookshaw(KERNEL, 2, wet, out) == 0);
    if (kept) {
        CHECK(sph_wall_rows_adami(KERNEL, 2, walls, wall, out, sph_scalar_out_array(rhs, 0)) == 0);
        for (sph_index i = WET; i < ALL; i++) { /* normalised, of the fluid alone */
            double sum = 0.0;
            for (sph_index q = found.list.start[i]; q < found.list.start[i + 1]; q++) {
                sum += (double)out.row[q];
                CHECK_AT("an entry of the row of a wall particle", i, found.list.index[q] < WET ? out.row[q] <= SPH_R(0) : out.row[q] == SPH_R(0));
            }
            CHECK_NEAR("sum of the row of a wall particle", i, sum + (double)diagonal[i], 0.0, BY_PRECISION(1e-14, 1e-6));
        }
    } else {
        CHECK(sph_wall_rows_eliminate(2, wet, wall, out, sph_scalar_out_array(rhs, 0)) == 0);
        for (sph_index i = WET; i < ALL; i++) diagonal[i] = SPH_R(1); /* they are in no row: anything */
        for (sph_index q = found.list.start[WET]; q < found.list.start[ALL]; q++) out.row[q] = SPH_R(0);
    }
    for (sph_index i = 0; i < ALL; i++) {
        const int top = i >= WET - SIDE && i < WET;
        a[i * ALL + i] = top ? 1.0 : (double)diagonal[i];
        b[i] = top ? 1.5 * g * (1.0 - (double)c.y[i]) : (double)rhs[i];
        for (sph_index q = found.list.start[i]; q < found.list.start[i + 1] && !top; q++) a[i * ALL + found.list.index[q]] += (double)out.row[q];
    }
    eliminate(ALL, a, b);
    for (sph_index i = 0; i < WET; i++) worst = fmax(worst, fabs(b[i] / (1.5 * g) - (1.0 - (double)c.y[i])));
    free(a), free(b), free(memory), free(out.row);
    cloud_free(&c);
    return worst;
}
static void test_wall_rows(void)
{
    for (int kept = 0; kept < 2; kept++)
        for (int disorder = 0; disorder < 2; disorder++)
            for (int scheme = 0; scheme < (int)SCHEMES; scheme++) {
                const double off = still_water(scheme, kept, 0.2 * disorder);
                if (scheme != BROOKSHAW) CHECK_WORST(check_words("still water, %s, walls %s", scheme_name[scheme], kept ? "kept" : "eliminated"), off, BY_PRECISION(1e-9, 1e-3));
                else CHECK(off > 1e-3); /* its rows are not exact for linear fields */
            }
}

int main(void)
{
    test_linear();
    test_order();
    test_fallback();
    test_periodic();
    test_mirror();
    test_wall_rows();
    return check_report("test_fits");
}
