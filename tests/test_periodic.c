/* SPDX-License-Identifier: MIT */
/*
 * test_periodic.c - operators in periodic boxes: the same as on a cloud with explicit copies beyond the box, wherever the particles are said to be; fields that are linear
 * along an open axis, waves along a periodic one, and boxes that are no boxes.
 */
#include "one_copy.h"
#include "sph_ops.h"

#include "../examples/common/random.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define BY_PRECISION(in_double, in_float) (SPH_SINGLE ? (in_float) : (in_double))
enum { OUTPUTS = 11 };

/* `n` targets; sources from n on are copies of them, owner[j]. box[a] = 0: open */
typedef struct tile {
    int dim;
    sph_index n, all;
    double box[3];
    sph_real h, *x[3], *V, *f;
    sph_index *owner, *start, *index;
} tile;

static void *memory(size_t count, size_t size)
{
    void *const p = calloc(count ? count : 1, size);
    if (!p) abort();
    return p;
}
static tile tile_new(int dim, sph_index all)
{
    tile t;
    int a;
    t.dim = dim;
    t.n = t.all = all;
    t.h = SPH_R(1);
    for (a = 0; a < 3; a++) {
        t.box[a] = 0.0;
        t.x[a] = (sph_real *)memory((size_t)all, sizeof(sph_real));
    }
    t.V = (sph_real *)memory((size_t)all, sizeof(sph_real));
    t.f = (sph_real *)memory((size_t)all, sizeof(sph_real));
    t.owner = (sph_index *)memory((size_t)all, sizeof(sph_index));
    t.start = (sph_index *)memory((size_t)all + 1, sizeof(sph_index));
    t.index = 0;
    return t;
}
static void tile_free(tile *t)
{
    int a;
    for (a = 0; a < 3; a++) free(t->x[a]);
    free(t->V);
    free(t->f);
    free(t->owner);
    free(t->start);
    free(t->index);
}
static sph_cloud tile_cloud(const tile *t)
{
    const sph_points x = sph_points_separate(t->all, t->x[0], t->x[1], t->x[2]);
    const sph_points boxed = sph_points_periodic(x, SPH_R(t->box[0]), SPH_R(t->box[1]), SPH_R(t->box[2]));
    const sph_list list = {t->start, t->index};
    const sph_cloud all = sph_cloud_of(boxed, list, sph_scalars_same(&t->h), sph_scalars_array(t->V));
    return sph_cloud_range(all, 0, t->n);
}
/* rows of the targets, in the box of the tile: the nearest image within the radius, by trying all */
static void tile_lists(tile *t, double radius)
{
    int pass;
    for (pass = 0; pass < 2; pass++) {
        sph_index i, j, count = 0;
        for (i = 0; i < t->n; i++) {
            t->start[i] = count;
            for (j = 0; j < t->all; j++) {
                double s = 0.0;
                int a;
                for (a = 0; a < t->dim; a++) {
                    double d = (double)t->x[a][i] - (double)t->x[a][j];
                    if (t->box[a] > 0.0) d -= t->box[a] * floor(d / t->box[a] + 0.5);
                    s += d * d;
                }
                if (j == i || s > radius * radius) continue;
                if (pass) t->index[count] = j;
                count++;
            }
        }
        for (; i <= t->all; i++) t->start[i] = count;
        if (pass == 0) {
            free(t->index);
            t->index = (sph_index *)memory((size_t)count, sizeof(sph_index));
        }
    }
}

/* sides[a] particles, dx apart, along the axis a, which is periodic if the bit a of `periodic` is set */
static tile tile_cells(int dim, const int *sides, double dx, int periodic, double jitter, double h_over_dx, uint64_t seed)
{
    tile t = tile_new(dim, (sph_index)(sides[0] * sides[1] * sides[2]));
    pcg32 g;
    sph_index i;
    int a;
    pcg32_seed(&g, seed, 17);
    for (a = 0; a < dim; a++) t.box[a] = periodic >> a & 1 ? dx * sides[a] : 0.0;
    for (i = 0; i < t.n; i++) {
        const int cell[3] = {(int)i % sides[0], (int)i / sides[0] % sides[1], (int)i / sides[0] / sides[1]};
        for (a = 0; a < dim; a++) t.x[a][i] = SPH_R((cell[a] + 0.5 + jitter * (2.0 * pcg32_uniform(&g) - 1.0)) * dx);
        t.V[i] = SPH_R((1.0 + 0.3 * pcg32_uniform(&g)) * pow(dx, dim));
        t.f[i] = SPH_R(2.0 * pcg32_uniform(&g) - 1.0);
        t.owner[i] = i;
    }
    t.h = SPH_R(h_over_dx * dx);
    tile_lists(&t, 2.02 * h_over_dx * dx);
    return t;
}
static tile tile_lattice(int dim, int side, int periodic, double jitter, double h_over_dx, uint64_t seed)
{
    const int sides[3] = {side, dim > 1 ? side + 1 : 1, dim > 2 ? side + 2 : 1}; /* axes that could be mistaken for each other hide mistakes */
    return tile_cells(dim, sides, 1.0 / side, periodic, jitter, h_over_dx, seed);
}
/* the same cloud with copies on all sides of the periodic axes, in an open box */
static tile tile_replicated(const tile *p, double radius)
{
    const int c0 = p->box[0] > 0.0, c1 = p->box[1] > 0.0, c2 = p->box[2] > 0.0;
    tile t = tile_new(p->dim, (sph_index)(p->n * (2 * c0 + 1) * (2 * c1 + 1) * (2 * c2 + 1)));
    sph_index i, next = p->n;
    int u, v, w;
    t.n = p->n;
    t.h = p->h;
    for (u = -c0; u <= c0; u++)
        for (v = -c1; v <= c1; v++)
            for (w = -c2; w <= c2; w++) {
                const int own = !u && !v && !w;
                for (i = 0; i < p->n; i++) {
                    const sph_index j = own ? i : next++;
                    t.x[0][j] = SPH_R((double)p->x[0][i] + u * p->box[0]);
                    t.x[1][j] = SPH_R((double)p->x[1][i] + v * p->box[1]);
                    t.x[2][j] = SPH_R((double)p->x[2][i] + w * p->box[2]);
                    t.V[j] = p->V[i];
                    t.f[j] = p->f[i];
                    t.owner[j] = i;
                }
            }
    tile_lists(&t, radius);
    return t;
}

/* ---- every operator that has one value a target or an entry ---- */

enum {
    SHEPARD,
    INTERPOLATE,
    DIFFERENCE,
    GRADIENT,
    BROOKSHAW,
    CSPM,
    ICSPM,
    WLS,
    DENSITY,
    ADAPTIVE,
    PER_TARGET,
    GRADIENT_ROWS,
    BROOKSHAW_ROWS,
    CSPM_ROWS,
    ICSPM_ROWS,
    WLS_ROWS,
    OPERATORS
};

static sph_index apply(int which, const tile *t, sph_real *const *out)
{
    const sph_kernel k = SPH_WENDLAND_C2;
    const sph_cloud targets = tile_cloud(t);
    const sph_scalars f = sph_scalars_array(t->f);
    const sph_vector_out vector = sph_vector_out_separate(out[0], out[1], out[2]);
    const sph_real reach = SPH_R(2) * t->h;
    const sph_density_options options = {sph_scalars_same(&reach), SPH_R(1.2),
                                         BY_PRECISION(SPH_R(1e-12), SPH_R(1e-5))};
    sph_derivatives_out d;
    sph_rows_out r = {0};
    sph_index i;
    memset(&d, 0, sizeof d);
    memset(&r, 0, sizeof r);
    d.gx = out[0], d.gy = out[1], d.gz = out[2], d.hxx = out[3], d.hxy = out[4], d.hyy = out[5], d.hxz = out[6], d.hyz = out[7], d.hzz = out[8],
    d.laplacian = out[9];
    r.row = out[0];
    switch (which) {
    case SHEPARD:
        return sph_shepard_sum(k, t->dim, targets, sph_scalar_out_array(out[0], 0));
    case INTERPOLATE:
        return sph_interpolate_shepard(k, t->dim, targets, f, sph_scalar_out_array(out[0], 0));
    case DIFFERENCE:
        return sph_gradient_difference(k, t->dim, targets, f, vector);
    case GRADIENT:
        return sph_gradient_cspm(k, t->dim, targets, f, d);
    case BROOKSHAW:
        return sph_laplacian_brookshaw(k, t->dim, targets, f, sph_scalar_out_array(out[0], 0));
    case CSPM:
        return sph_derivatives_cspm(k, t->dim, targets, f, (sph_derivatives_options){0}, d);
    case ICSPM:
        return sph_derivatives_icspm(k, t->dim, targets, f, (sph_derivatives_options){0}, d);
    case WLS:
        return sph_derivatives_wls(k, t->dim, targets, f, (sph_derivatives_options){0}, d);
    case DENSITY:
        return sph_density_summation(k, t->dim, targets, targets.volume, sph_scalar_out_array(out[0], 0));
    case ADAPTIVE: /* eta a little less than the h of the cloud: most have a solution; what is suggested to the others depends on the box, and is not compared */
        for (i = 0; i < t->n; i++) out[1][i] = SPH_R(0.8) * t->h;
        (void)sph_density_adaptive(k, t->dim, targets, targets.volume, options,
                                   (sph_density_out){.h = out[1], .rho = out[0], .omega = out[2]});
        for (i = 0; i < t->n; i++)
            if (out[1][i] > t->h) out[1][i] = t->h;
        return 0;
    case GRADIENT_ROWS:
        return sph_gradient_rows_cspm(k, t->dim, targets,
                                      (sph_gradient_rows_out){.x = out[0], .y = out[1], .z = out[2]});
    case BROOKSHAW_ROWS:
        return sph_laplacian_rows_brookshaw(k, t->dim, targets, (sph_rows_out){.row = out[0]});
    case CSPM_ROWS:
        return sph_derivatives_rows_cspm(k, t->dim, targets, sph_jet_laplacian(t->dim), r);
    case ICSPM_ROWS:
        return sph_derivatives_rows_icspm(k, t->dim, targets, sph_jet_laplacian(t->dim), r);
    default:
        return sph_derivatives_rows_wls(k, t->dim, targets, sph_jet_laplacian(t->dim), r);
    }
}

static int nothing(const sph_real *v, size_t n)
{
    size_t i;
    for (i = 0; i < n && v[i] == SPH_R(0); i++) {}
    return i == n;
}

/* The largest difference between the outputs on two tiles, relative to the largest output. Entries of rows are compared by the owner of the neighbour. */
static double difference(int which, const tile *p, const tile *q)
{
    const size_t pairs_p = (size_t)p->start[p->n], pairs_q = (size_t)q->start[q->n];
    const size_t size = 1 + (pairs_p > pairs_q ? pairs_p : pairs_q) + (size_t)q->all + (size_t)p->all;
    sph_real *a[OUTPUTS], *b[OUTPUTS];
    double worst = 0.0, largest = 0.0;
    sph_index i, answer_p, answer_q;
    int c;
    for (c = 0; c < OUTPUTS; c++) {
        a[c] = (sph_real *)memory(size, sizeof(sph_real));
        b[c] = (sph_real *)memory(size, sizeof(sph_real));
    }
    answer_p = apply(which, p, a);
    answer_q = apply(which, q, b);
    CHECK(answer_p == 0 && answer_q == 0);
    for (c = 0; c < OUTPUTS; c++) {
        double worst_c = 0.0, largest_c = 0.0;
        if (nothing(a[c], size) && nothing(b[c], size)) continue; /* it has no such output */
        for (i = 0; i < p->n; i++) {
            if (which < (int)PER_TARGET) {
                worst_c = fmax(worst_c, fabs((double)a[c][i] - (double)b[c][i]));
                largest_c = fmax(largest_c, fabs((double)a[c][i]));
            } else { /* what the row gives to each particle: with a support below half the box it has one image there */
                sph_index s, u;
                for (s = p->start[i]; s < p->start[i + 1]; s++) {
                    double other = 0.0;
                    for (u = q->start[i]; u < q->start[i + 1]; u++)
                        if (q->owner[q->index[u]] == p->owner[p->index[s]]) other += (double)b[c][u];
                    worst_c = fmax(worst_c, fabs((double)a[c][s] - other));
                    largest_c = fmax(largest_c, fabs((double)a[c][s]));
                }
            }
        }
        if (largest_c > 0.0) worst = fmax(worst, worst_c / largest_c);
        largest = fmax(largest, largest_c);
    }
    CHECK(largest > 0.0);
    for (c = 0; c < OUTPUTS; c++) {
        free(a[c]);
        free(b[c]);
    }
    return worst;
}

static void test_copies_and_shifts(int dim)
{
    const double h_over_dx = dim == 3 ? 1.4 : 1.7;
    int periodic, which;
    for (periodic = 0; periodic < 1 << dim; periodic++) {
        tile t = tile_lattice(dim, dim == 3 ? 6 : 8, periodic, 0.15, h_over_dx, 40 + (uint64_t)periodic),
             shifted = tile_lattice(dim, dim == 3 ? 6 : 8, periodic, 0.15, h_over_dx, 40 + (uint64_t)periodic);
        tile copies = tile_replicated(&t, 2.02 * (double)t.h);
        const double shift[3] = {7.0, -3.0, 5.0}; /* by whole numbers and fractions that the numbers of the machine hold: positions must stay the same */
        pcg32 g;
        sph_index i;
        int a;
        pcg32_seed(&g, 3, 1);
        for (a = 0; a < dim; a++)
            for (i = 0; i < t.n; i++) {
                double x = (double)t.x[a][i] + 0.125 * shift[a];
                if (t.box[a] > 0.0) x += t.box[a] * ((double)(pcg32_next(&g) % 9) - 4.0); /* anywhere within nine boxes */
                shifted.x[a][i] = SPH_R(x);
            }
        tile_lists(&shifted, 2.02 * (double)t.h);
        for (which = 0; which < (int)OPERATORS; which++) {
            /* round-off of coordinates is magnified by the inverse of systems, and by second differences */
            const double magnified = which == ICSPM || which == ICSPM_ROWS || which == WLS || which == WLS_ROWS ? 100.0 : 1.0;
            if (which == (int)PER_TARGET) continue;
            CHECK_CLOSE(difference(which, &t, &copies), 0.0, magnified * BY_PRECISION(2e-13, 1e-4));
            CHECK_CLOSE(difference(which, &t, &shifted), 0.0, magnified * BY_PRECISION(2e-12, 1e-3));
        }
        tile_free(&t);
        tile_free(&shifted);
        tile_free(&copies);
    }
}

/* Half a million boxes away, with a box whose length is a power of two so that nothing is lost but in float; the pair vector alone. */
static void test_separation(void)
{
    sph_points p = sph_points_periodic(sph_points_separate(1, 0, 0, 0), SPH_R(0.5), SPH_R(0), SPH_R(2));
    const double boxes[6] = {0.0, 1.0, -1.0, 1000.0, -4096.0, BY_PRECISION(524288.0, 65536.0)};
    int u, v;
    CHECK(!(sph_points_separate(1, 0, 0, 0).box.x > SPH_R(0)) && !(sph_points_strided(1, 0, 0, 0, 3).box.z > SPH_R(0)));
    for (u = 0; u < 6; u++)
        for (v = 0; v < 6; v++) {
            sph_vec a, b, d;
            a.x = SPH_R(0.4375 + 0.5 * boxes[u]);
            b.x = SPH_R(0.0625 + 0.5 * boxes[v]);
            a.y = SPH_R(boxes[u]);
            b.y = SPH_R(boxes[v]);
            a.z = SPH_R(0.25 + 2.0 * boxes[v]);
            b.z = SPH_R(1.0 + 2.0 * boxes[u]);
            d = sphi_separation(3, p, a, b);
            CHECK_CLOSE((double)d.x, -0.125, 0.0);
            CHECK_CLOSE((double)d.y, boxes[u] - boxes[v], 0.0); /* open */
            CHECK_CLOSE((double)d.z, -0.75, 0.0);
            d = sphi_separation(3, p, b, a);
            CHECK_CLOSE((double)d.x, 0.125, 0.0);
            CHECK_CLOSE((double)d.z, 0.75, 0.0);
        }
    /* half a box: either image will do */
    for (u = -9; u <= 9; u++) {
        sph_vec a, b, d;
        a.x = SPH_R(0.25 * u);
        b.x = b.y = b.z = a.y = a.z = SPH_R(0);
        d = sphi_separation(1, p, a, b);
        CHECK_CLOSE(fabs((double)d.x), u % 2 ? 0.25 : 0.0, 0.0);
    }
    /* an open axis may be as long as it likes */
    {
        sph_vec a, b, d;
        a.x = b.x = b.y = a.z = b.z = SPH_R(0);
        a.y = BY_PRECISION(SPH_R(1e200), SPH_R(1e30));
        d = sphi_separation(2, p, a, b);
        CHECK_RELATIVE((double)d.y, (double)a.y, 0.0);
    }
}

/* linear along the open axis, waves along the periodic ones */
static void test_fields(int dim)
{
    int open;
    for (open = 0; open < dim; open++) {
        tile t = tile_lattice(dim, dim == 3 ? 6 : 9, (1 << dim) - 1 - (1 << open), 0.2, dim == 3 ? 1.4 : 1.6, 77);
        sph_real *const g[3] = {(sph_real *)memory((size_t)t.n, sizeof(sph_real)), (sph_real *)memory((size_t)t.n, sizeof(sph_real)),
                                (sph_real *)memory((size_t)t.n, sizeof(sph_real))};
        sph_index i;
        int a;
        for (i = 0; i < t.n; i++) t.f[i] = SPH_R(0.3) + SPH_R(1.7) * t.x[open][i];
        CHECK(sph_gradient_cspm(SPH_WENDLAND_C2, dim, tile_cloud(&t), sph_scalars_array(t.f),
                                (sph_derivatives_out){.gx = g[0], .gy = g[1], .gz = g[2]}) == 0);
        for (i = 0; i < t.n; i++)
            for (a = 0; a < dim; a++) CHECK_CLOSE((double)g[a][i], a == open ? 1.7 : 0.0, BY_PRECISION(1e-12, 5e-5));
        for (a = 0; a < 3; a++) free(g[a]);
        tile_free(&t);
    }
}

/* The Laplacian of a wave along one axis of a periodic lattice: second order everywhere, because nothing is a boundary. By ICSPM, which has no error of the lattice's own. */
static void test_wave(int dim, int axis)
{
    double error[2];
    int finer;
    for (finer = 0; finer < 2; finer++) {
        const int side = 16 << finer, sides[3] = {axis == 0 ? side : 7, dim < 2 ? 1 : axis == 1 ? side : 8, dim < 3 ? 1 : axis == 2 ? side : 9};
        tile t = tile_cells(dim, sides, 1.0 / side, (1 << dim) - 1, 0.0, 1.5, 1);
        sph_real *const out = (sph_real *)memory((size_t)t.n, sizeof(sph_real));
        const double a = 2.0 * PI / t.box[axis];
        sph_derivatives_out d;
        sph_index i;
        memset(&d, 0, sizeof d);
        d.laplacian = out;
        error[finer] = 0.0;
        for (i = 0; i < t.n; i++) {
            t.V[i] = SPH_R(1);
            t.f[i] = SPH_R(sin(a * (double)t.x[axis][i]));
        }
        CHECK(sph_derivatives_icspm(SPH_WENDLAND_C2, dim, tile_cloud(&t), sph_scalars_array(t.f), (sph_derivatives_options){0}, d) == 0);
        for (i = 0; i < t.n; i++) error[finer] = fmax(error[finer], fabs((double)out[i] / (a * a) + sin(a * (double)t.x[axis][i])));
        free(out);
        tile_free(&t);
    }
    CHECK(error[0] < 0.1 && error[0] > 1e-3);
    CHECK_CLOSE(log(error[0] / error[1]) / log(2.0), 2.0, 0.15);
}

/* ---- boxes that just do ---- */

static void test_limits(int dim)
{
    tile t = tile_lattice(dim, 8, (1 << dim) - 1, 0.1, 1.5, 5);
    const double good = t.box[dim - 1];
    sph_real *out[OUTPUTS];
    int c;
    for (c = 0; c < OUTPUTS; c++) out[c] = (sph_real *)memory((size_t)(t.start[t.n] + t.n), sizeof(sph_real));
    t.box[dim - 1] = 0.75; /* exactly half of it is still right */
    CHECK(apply(SHEPARD, &t, out) == 0);
    t.box[dim - 1] = good;
    for (c = 0; c < 2; c++) { /* beyond what can be counted, and just within */
        const sph_real kept = t.x[dim - 1][2];
        t.x[dim - 1][2] = SPH_R((c ? -1048570.0 : 1048580.0) * good);
        CHECK(apply(SHEPARD, &t, out) == (c ? 0 : SPH_ERROR_BOX));
        t.x[dim - 1][2] = kept;
    }
    /* axes beyond dim are not looked at */
    if (dim < 3) {
        t.box[dim] = -1.0;
        CHECK(apply(SHEPARD, &t, out) == 0);
    }
    for (c = 0; c < OUTPUTS; c++) free(out[c]);
    tile_free(&t);
}

/* the boundary-integral operator has ends, a periodic axis has none */
static void test_bim(void)
{
    tile t = tile_lattice(1, 16, 1, 0.1, 1.5, 5);
    sph_real out[16], row[256];
    const sph_scalars f = sph_scalars_array(t.f);
    const sph_scalar_out to = sph_scalar_out_array(out, 0);
    CHECK(t.start[t.n] <= 256);
    CHECK(sph_second_derivative_bim(SPH_WENDLAND_C4_1D, tile_cloud(&t), f, 0, 15, to) == SPH_ERROR_BOX);
    CHECK(sph_second_derivative_rows_bim(SPH_WENDLAND_C4_1D, tile_cloud(&t), 0, 15, (sph_rows_out){.row = row}) == SPH_ERROR_BOX);
    t.box[0] = 0.0;
    tile_lists(&t, 2.02 * (double)t.h);
    /* the ends themselves */
    CHECK(sph_second_derivative_bim(SPH_WENDLAND_C4_1D, tile_cloud(&t), f, 0, 15, to) == 2);
    tile_free(&t);
}

int main(void)
{
    int dim, axis;
    test_separation();
    for (dim = 1; dim <= 3; dim++) {
        test_copies_and_shifts(dim);
        test_fields(dim);
        for (axis = 0; axis < dim; axis++) test_wave(dim, axis);
        test_limits(dim);
    }
    test_bim();
    CHECK(strcmp(sph_status_text(SPH_ERROR_BOX), sph_status_text(-1000)) != 0);
    return check_report("test_periodic");
}
