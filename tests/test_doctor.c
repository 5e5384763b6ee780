/* SPDX-License-Identifier: MIT */
/*
 * test_doctor.c - sph_cloud_examine finds each likely mistake, names a pair that shows it, and finds nothing
 * in healthy clouds.
 *
 * A scene is a cloud whose list was made by comparing all pairs. A mistake is made in it, and that one alone
 * must be found.
 */
#include "one_copy.h"
#include "sph.h"

#include "check.h"
#include "clouds.h"

#include <string.h>

#ifndef SOAK
#define SOAK 0u /* other clouds: another number */
#endif
#ifndef LAST_DIM
#define LAST_DIM 3
#endif
#define BIT(finding) (1u << (finding))
enum { BOTH = 1, OWN = 0, OPEN = 0, PERIODIC = 1 };

typedef struct scene {
    int dim, both;
    sph_kernel k;
    sph_index n, targets, pairs,
        spare; /* spare: memory of the coordinates beyond n, for strides that read there */
    double dx, box[3], seen_box[3]; /* that of the list, and that which the cloud is given */
    sph_real *x[3], *V, *h;
    sph_index *start, *index;
    sph_cloud cloud; /* as it is examined */
} scene;

static void scene_view(scene *s)
{
    sph_list list;
    sph_points p = sph_points_separate(s->n, s->x[0], s->x[1], s->x[2]);
    list.start = s->start;
    list.index = s->index;
    p = sph_points_periodic(p, SPH_R(s->seen_box[0]), SPH_R(s->seen_box[1]), SPH_R(s->seen_box[2]));
    s->cloud = sph_cloud_range(sph_cloud_of(p, list, sph_scalars_array(s->h), sph_scalars_array(s->V)), 0,
                               s->targets);
}
static scene scene_new(sph_kernel k, int dim, sph_index n, double dx)
{
    scene s;
    sph_index i;
    int a;
    memset(&s, 0, sizeof s);
    s.k = k;
    s.dim = dim;
    s.n = s.targets = n;
    s.dx = dx;
    for (a = 0; a < 3; a++) s.x[a] = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
    s.V = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
    s.h = (sph_real *)cloud_memory((size_t)n, sizeof(sph_real));
    s.start = (sph_index *)cloud_memory((size_t)n + 1, sizeof(sph_index));
    for (i = 0; i < n; i++) {
        s.V[i] = SPH_R(pow(dx, dim));
        s.h[i] = SPH_R((double)sph_kernel_h_over_dx(k) * dx);
    }
    return s;
}
static void scene_free(scene *s)
{
    int a;
    for (a = 0; a < 3; a++) free(s->x[a]);
    free(s->V);
    free(s->h);
    free(s->start);
    free(s->index);
}
static double distance(const scene *s, sph_index i, sph_index j, const double *box)
{
    double r2 = 0.0;
    int a;
    for (a = 0; a < s->dim; a++) {
        double d = (double)s->x[a][i] - (double)s->x[a][j];
        if (box[a] > 0.0 && fabs(d) > 0.5 * box[a]) d -= box[a] * floor(d / box[a] + 0.5);
        r2 += d * d;
    }
    return sqrt(r2);
}
/* Rows of all r < factor * (support ratio * h by the criterion, or `fixed` if positive). half: only j > i. */
static void scene_list(scene *s, int criterion, double factor, double fixed, int half_list)
{
    const double ratio = (double)sph_kernel_support_ratio(s->k);
    sph_index i, j, pairs = 0, room = 64 * s->n;
    s->index = (sph_index *)realloc(s->index, (size_t)room * sizeof(sph_index));
    for (i = 0; i < s->n && s->index; i++) {
        s->start[i] = pairs;
        if (pairs + s->n > room) {
            room = 2 * (pairs + s->n);
            s->index = (sph_index *)realloc(s->index, (size_t)room * sizeof(sph_index));
            if (!s->index) break;
        }
        for (j = half_list ? i + 1 : 0; j < s->n && i < s->targets; j++) {
            const double a = ratio * (double)s->h[i], b = ratio * (double)s->h[j];
            const double by_h = criterion == SPH_GATHER    ? a
                                : criterion == SPH_SCATTER ? b
                                : criterion == SPH_MEAN    ? 0.5 * (a + b)
                                : a > b                    ? a
                                                           : b;
            if (j != i && distance(s, i, j, s->box) < factor * (fixed > 0.0 ? fixed : by_h))
                s->index[pairs++] = j;
        }
    }
    if (!s->index) abort();
    s->start[s->n] = pairs;
    s->pairs = pairs;
    s->index = (sph_index *)realloc(s->index,
                                    (size_t)(pairs ? pairs : 1) *
                                        sizeof(sph_index)); /* so that a checker sees what is read beyond */
    if (!s->index) abort();
    scene_view(s);
}
static int side_of(int dim) { return dim == 1 ? 60 : dim == 2 ? 15 : 8; }
static void jitter(scene *s, double amount, uint64_t seed)
{
    pcg32 g;
    sph_index i;
    int a;
    pcg32_seed(&g, seed + SOAK, 3);
    for (i = 0; i < s->n; i++)
        for (a = 0; a < s->dim; a++)
            s->x[a][i] = SPH_R((double)s->x[a][i] + amount * s->dx * cloud_symmetric(&g));
}
/* Particles in another order: h and V are the same for all as long as this is used. */
static void shuffle(scene *s, uint64_t seed)
{
    pcg32 g;
    sph_index i;
    int a;
    pcg32_seed(&g, seed + SOAK, 5);
    for (i = s->n - 1; i > 0; i--) {
        sph_index j = (sph_index)(pcg32_uniform(&g) * (double)(i + 1));
        if (j > i) j = i;
        for (a = 0; a < s->dim; a++) {
            const sph_real t = s->x[a][i];
            s->x[a][i] = s->x[a][j];
            s->x[a][j] = t;
        }
    }
}
/* a block of side^dim particles, jittered; periodic or with free surfaces on all sides; a list of the
   support */
static scene block(sph_kernel k, int dim, double amount, int periodic, uint64_t seed)
{
    const int side = side_of(dim);
    const double dx = 0.1;
    scene s = scene_new(k, dim,
                        (sph_index)(dim == 1   ? side
                                    : dim == 2 ? side * side
                                               : side * side * side),
                        dx);
    sph_index i;
    int a;
    for (i = 0; i < s.n; i++)
        for (a = 0; a < dim; a++)
            s.x[a][i] = SPH_R((0.5 + (double)(a == 0   ? i % side
                                              : a == 1 ? i / side % side
                                                       : i / side / side)) *
                              dx);
    for (a = 0; a < dim && periodic; a++) s.box[a] = s.seen_box[a] = side * dx;
    jitter(&s, amount, seed);
    if (seed & 1) shuffle(&s, seed);
    scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
    return s;
}
/* h varies by 5 along x */
static void spread_h(scene *s)
{
    double low = 1e30, high = -1e30;
    sph_index i;
    for (i = 0; i < s->n; i++) {
        if ((double)s->x[0][i] < low) low = (double)s->x[0][i];
        if ((double)s->x[0][i] > high) high = (double)s->x[0][i];
    }
    for (i = 0; i < s->n; i++)
        s->h[i] = SPH_R(s->dx * (s->dim == 3 ? 0.8 : 1.0) *
                        (0.6 + 2.4 * ((double)s->x[0][i] - low) / (high - low)));
}

static const char *label = "";
static int listed(const scene *s, sph_index i, sph_index j)
{
    sph_index p;
    if (i < 0 || i >= s->targets) return 0;
    for (p = s->start[i]; p < s->start[i + 1]; p++)
        if (s->index[p] == j) return 1;
    return 0;
}
/* Exactly the findings of `set`. */
static sph_findings expect(const scene *s, unsigned set, sph_index samples)
{
    sph_findings f;
    const sph_index answer = sph_cloud_examine(s->k, s->dim, s->cloud, s->both, samples, &f);
    sph_index count = 0;
    int b;
    CHECK(answer >= 0);
    if (answer < 0) {
        fprintf(stderr, "  %s: dim %d, %s: answer %d\n", label, s->dim, sph_kernel_name(s->k), (int)answer);
        memset(&f, 0, sizeof f);
        return f;
    }
    for (b = 0; b < SPH_FINDING_COUNT; b++) {
        count += (sph_index)((f.set >> b) & 1u);
        CHECK((f.at[b].particle >= 0) == (((f.set >> b) & 1u) != 0));
    }
    CHECK(answer == count);
    CHECK(f.set == set);
    if (f.set != set)
        fprintf(stderr, "  %s: dim %d, %s, both %d, n %d: found %#x, expected %#x\n", label, s->dim,
                sph_kernel_name(s->k), s->both, (int)s->n, f.set, set);
    return f;
}
static void healthy(const scene *s)
{
    expect(s, 0u, 0);
    expect(s, 0u, 5);
    if (s->n < 300) expect(s, 0u, s->n);
}
/* the finding, and a pair that is nearer than the support allows and does not stand in the row */
static sph_findings expect_missing(const scene *s, int finding)
{
    const sph_findings f = expect(s, BIT(finding), 0);
    const sph_offender o = f.at[finding];
    if (f.set & BIT(finding)) {
        const double ratio = (double)sph_kernel_support_ratio(s->k), a = ratio * (double)s->h[o.particle],
                     b = ratio * (double)s->h[o.neighbour];
        const double R = s->both && b > a ? b : a;
        const double box[3] = {(double)s->cloud.points.box.x, (double)s->cloud.points.box.y,
                               (double)s->cloud.points.box.z};
        CHECK(o.particle != o.neighbour && !listed(s, o.particle, o.neighbour));
        CHECK(distance(s, o.particle, o.neighbour, box) < R);
        CHECK_CLOSE((double)o.ratio, distance(s, o.particle, o.neighbour, box) / R, 2e-5);
    }
    return f;
}

enum { KERNELS = 4 };
static const sph_kernel kernel_of[KERNELS] = {SPH_WENDLAND_C2, SPH_CUBIC_SPLINE, SPH_QUARTIC_SPLINE,
                                              SPH_QUINTIC_SPLINE}; /* support 2, 2, 2.5, 3 */
static const double jitter_of[3] = {0.0, 0.15, 0.3};

static void check_healthy(int dim, sph_kernel k)
{
    int a, periodic;
    for (a = 0; a < 3; a++)
        for (periodic = 0; periodic < 2 && (dim < 3 || a != 1); periodic++) {
            scene s = block(k, dim, jitter_of[a], periodic, (uint64_t)(10 * a + periodic));
            sph_index i;
            label = "healthy";
            healthy(&s);
            s.both = BOTH;
            healthy(&s);
            label = "healthy, unwrapped";
            for (i = 0; i < s.n && periodic; i += 3)
                s.x[dim - 1][i] = SPH_R((double)s.x[dim - 1][i] + 2.0 * s.box[dim - 1]);
            healthy(&s);
            for (i = 0; i < s.n && periodic; i += 3)
                s.x[dim - 1][i] = SPH_R((double)s.x[dim - 1][i] - 2.0 * s.box[dim - 1]);
            label = "healthy, long list";
            scene_list(&s, SPH_GATHER, 1.2, 0.0, 0);
            healthy(&s);
            label = "healthy, list of some steps ago"; /* moved by less than half of the skin, 0.1 R */
            jitter(&s,
                   0.1 * (double)sph_kernel_support_ratio(k) * (double)sph_kernel_h_over_dx(k) / sqrt((double)dim),
                   77);
            healthy(&s);
            label = "healthy, very long list";
            scene_list(&s, SPH_GATHER, periodic ? 1.4 : 2.0, 0.0, 0);
            healthy(&s);
            label = "no volumes";
            s.cloud.volume = sph_scalars_none();
            healthy(&s);
            scene_free(&s);
        }
}
static void check_healthy_adaptive(int dim, sph_kernel k)
{
    int a;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1) {
        scene s = block(k, dim, jitter_of[a], OPEN, (uint64_t)a);
        spread_h(&s);
        scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
        label = "adaptive, gather";
        healthy(&s);
        label = "adaptive, gather, long";
        scene_list(&s, SPH_GATHER, 1.2, 0.0, 0);
        healthy(&s);
        label = "adaptive, larger, long";
        scene_list(&s, SPH_LARGER, 1.2, 0.0, 0);
        healthy(&s);
        s.both = BOTH;
        healthy(&s);
        label = "adaptive, larger";
        scene_list(&s, SPH_LARGER, 1.0, 0.0, 0);
        healthy(&s);
        s.both = OWN;
        healthy(&s);
        label = "adaptive, one radius for all";
        scene_list(&s, SPH_GATHER, 1.0, (double)sph_kernel_support_ratio(k) * 3.0 * s.dx, 0);
        healthy(&s);
        s.both = BOTH;
        healthy(&s);
        scene_free(&s);
    }
}
static void check_healthy_shapes(int dim, sph_kernel k)
{
    scene s = block(k, dim, 0.2, OPEN, 2);
    sph_index i;
    label = "boundary particles";
    s.targets = s.n - s.n / 4;
    scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
    healthy(&s);
    s.both = BOTH;
    healthy(&s);
    label = "part of the range";
    s.cloud = sph_cloud_range(s.cloud, s.n / 3, s.n / 2);
    healthy(&s);
    s.cloud = sph_cloud_range(s.cloud, s.n / 3, s.n / 3);
    healthy(&s);
    s.cloud = sph_cloud_range(s.cloud, s.n / 3, s.n / 3 + 1);
    healthy(&s);
    scene_free(&s);

    label = "probes";
    {
        const scene body = block(k, dim, 0.2, OPEN, 4);
        const sph_index few = body.n / 6;
        pcg32 g;
        int a;
        pcg32_seed(&g, 4, 9);
        s = scene_new(k, dim, body.n + few, body.dx);
        for (i = 0; i < s.n; i++) {
            for (a = 0; a < dim; a++)
                s.x[a][i] =
                    i < body.n ? body.x[a][i] : SPH_R(1.5 * side_of(dim) * body.dx * pcg32_uniform(&g));
            if (i >= body.n) s.V[i] = SPH_R(0);
        }
        scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
        healthy(&s);
        s.cloud = sph_cloud_range(s.cloud, body.n, s.n);
        healthy(&s);
        s.cloud = sph_cloud_range(s.cloud, 0, body.n);
        healthy(&s);
        scene_free(&s);
        s = body;
        scene_free(&s);
    }

    label = "drop";
    s = block(k, dim, 0.1, OPEN, 6);
    {
        const double c = 0.5 * side_of(dim) * s.dx, R = 0.4 * side_of(dim) * s.dx;
        sph_index n = 0;
        int a;
        for (i = 0; i < s.n; i++) {
            double r2 = 0.0;
            for (a = 0; a < dim; a++) r2 += ((double)s.x[a][i] - c) * ((double)s.x[a][i] - c);
            if (r2 > R * R) continue;
            for (a = 0; a < dim; a++) s.x[a][n] = s.x[a][i];
            n++;
        }
        s.n = s.targets = n;
    }
    scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
    healthy(&s);
    scene_free(&s);

    label = "few particles";
    {
        static const sph_index counts[4] = {1, 2, 3, 5};
        int c, apart, a;
        for (c = 0; c < 4; c++)
            for (apart = 0; apart < 2; apart++) {
                s = scene_new(k, dim, counts[c], 0.1);
                for (i = 0; i < s.n; i++)
                    for (a = 0; a < dim; a++)
                        s.x[a][i] = SPH_R(a == 0  ? (apart ? 9.0 : 0.1) * (double)i
                                          : apart ? 0.0
                                                  : 0.03 * (double)((i * i + a) % 4));
                scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
                healthy(&s);
                s.cloud.points.y = dim > 1 ? s.x[1] : 0;
                s.cloud.points.z = dim > 2 ? s.x[2] : 0;
                healthy(&s);
                if (!apart) {
                    for (a = 0; a < dim; a++) s.box[a] = s.seen_box[a] = 5.0 * 0.1 * 2.0;
                    scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
                    healthy(&s);
                }
                scene_free(&s);
            }
    }
    label = "interleaved";
    s = block(k, dim, 0.2, PERIODIC, 8);
    {
        sph_real *const xyz = (sph_real *)cloud_memory((size_t)s.n * (size_t)dim, sizeof *xyz),
                        *const wide = (sph_real *)cloud_memory((size_t)s.n * 8, sizeof *wide);
        sph_points p;
        int a;
        for (i = 0; i < s.n; i++)
            for (a = 0; a < dim; a++) xyz[i * dim + a] = wide[i * 8 + a + 1] = s.x[a][i];
        p = sph_points_interleaved(s.n, dim, xyz);
        s.cloud.points = sph_points_periodic(p, SPH_R(s.box[0]), SPH_R(s.box[1]), SPH_R(s.box[2]));
        healthy(&s);
        p = sph_points_strided(s.n, wide + 1, dim > 1 ? wide + 2 : 0, dim > 2 ? wide + 3 : 0, 8);
        s.cloud.points = sph_points_periodic(p, SPH_R(s.box[0]), SPH_R(s.box[1]), SPH_R(s.box[2]));
        healthy(&s);
        free(xyz);
        free(wide);
    }
    scene_free(&s);
}

static void check_lists(int dim, sph_kernel k, int periodic)
{
    const double ratio = (double)sph_kernel_support_ratio(k), h_over_dx = (double)sph_kernel_h_over_dx(k);
    int a;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1) {
        scene s = block(k, dim, jitter_of[a], periodic, (uint64_t)(20 + a));
        sph_index i;
        int both;
        for (both = 0; both < 2; both++) {
            s.both = both;
            label = "list too short"; /* in 1D with twice the h: a lattice cannot tell, see below */
            for (i = 0; i < s.n && dim == 1; i++) s.h[i] *= SPH_R(2);
            scene_list(&s, SPH_GATHER, dim == 1 ? 0.75 : 0.8, 0.0, 0);
            expect_missing(&s, SPH_FINDING_LIST_SHORT);
            for (i = 0; i < s.n && dim == 1; i++) s.h[i] /= SPH_R(2);
            if (dim == 1 && a == 0 && k == SPH_WENDLAND_C2) {
                scene_list(&s, SPH_GATHER, 0.7, 0.0, 0);
                expect_missing(&s, SPH_FINDING_LIST_SUPPORT);
            }
            label = "radius h"; /* h < spacing: empty rows, LIST_SHORT */
            if (h_over_dx > 1.15) {
                scene_list(&s, SPH_GATHER, 1.0 / ratio, 0.0, 0);
                expect_missing(&s, SPH_FINDING_LIST_SUPPORT);
            }
            label = "h is the support radius";
            scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
            for (i = 0; i < s.n; i++) s.h[i] *= SPH_R(ratio);
            expect_missing(&s, SPH_FINDING_LIST_SUPPORT);
            for (i = 0; i < s.n; i++) s.h[i] /= SPH_R(ratio);
            label = "half list";
            scene_list(&s, SPH_GATHER, 1.0, 0.0, 1);
            expect_missing(&s, SPH_FINDING_LIST_HALF);
            label = "empty list";
            scene_list(&s, SPH_GATHER, 1e-6, 0.0, 0);
            expect_missing(&s, SPH_FINDING_LIST_SHORT);
        }
        s.both = OWN;
        label = "half list, boundary particles";
        s.targets = s.n - s.n / 5;
        scene_list(&s, SPH_GATHER, 1.0, 0.0, 1);
        expect_missing(&s, SPH_FINDING_LIST_HALF);
        s.targets = s.n;
        label = "other order";
        scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
        shuffle(&s, 91);
        expect_missing(&s, SPH_FINDING_LIST_STALE);
        label = "moved";
        scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
        jitter(&s, 0.8, 92);
        expect_missing(&s, SPH_FINDING_LIST_STALE);
        scene_free(&s);
    }
}
static void check_one_sided(int dim, sph_kernel k)
{
    int a;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1) {
        scene s = block(k, dim, jitter_of[a], OPEN, (uint64_t)(30 + a));
        spread_h(&s);
        label = "one-sided";
        s.both = BOTH;
        scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
        expect_missing(&s, SPH_FINDING_LIST_ONE_SIDED);
        scene_list(&s, SPH_SCATTER, 1.0, 0.0, 0);
        expect_missing(&s, SPH_FINDING_LIST_ONE_SIDED);
        scene_list(&s, SPH_MEAN, 1.0, 0.0, 0);
        expect_missing(&s, SPH_FINDING_LIST_ONE_SIDED);
        s.both = OWN;
        scene_list(&s, SPH_SCATTER, 1.0, 0.0, 0);
        expect_missing(&s, SPH_FINDING_LIST_ONE_SIDED);
        label = "adaptive, too short";
        scene_list(&s, SPH_GATHER, 0.8, 0.0, 0);
        expect_missing(&s, SPH_FINDING_LIST_SHORT);
        s.both = BOTH;
        scene_list(&s, SPH_LARGER, 0.8, 0.0, 0);
        expect_missing(&s, SPH_FINDING_LIST_SHORT);
        label = "adaptive, radius h";
        scene_list(&s, SPH_LARGER, 1.0 / (double)sph_kernel_support_ratio(k), 0.0, 0);
        expect_missing(&s, SPH_FINDING_LIST_SUPPORT);
        label = "adaptive, half";
        scene_list(&s, SPH_LARGER, 1.0, 0.0, 1);
        expect_missing(&s, SPH_FINDING_LIST_HALF);
        scene_free(&s);
    }
}
static void check_from_one(int dim, sph_kernel k, int periodic)
{
    int a, starts, part;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1)
        for (starts = 0; starts < 3; starts++) /* entries; entries and starts; starts */
            for (part = 0; part < 2; part++) {
                scene s = block(k, dim, jitter_of[a], periodic, (uint64_t)(40 + a));
                sph_index i;
                sph_findings f;
                label = "from one";
                for (i = 0; i < s.pairs && starts < 2; i++) s.index[i]++;
                for (i = 0; i <= s.n && starts > 0; i++) s.start[i]++;
                if (part && starts < 2) s.cloud = sph_cloud_range(s.cloud, s.n / 3, 2 * s.n / 3);
                f = expect(&s, BIT(SPH_FINDING_LIST_FROM_ONE), 0);
                CHECK(f.at[SPH_FINDING_LIST_FROM_ONE].particle == s.cloud.first);
                CHECK(f.at[SPH_FINDING_LIST_FROM_ONE].neighbour ==
                      s.index[s.start[s.cloud.first] - (starts > 0 && s.cloud.first == 0)]);
                scene_free(&s);
            }
}
static void check_box(int dim, sph_kernel k)
{
    int a, axis, mistake;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1)
        for (axis = 0; axis < dim; axis++)
            for (mistake = 0; mistake < 7; mistake++) {
                scene s = block(k, dim, jitter_of[a], PERIODIC, (uint64_t)(50 + a));
                const double length = s.box[axis];
                sph_findings f;
                label = mistake == 0   ? "box forgotten"
                        : mistake == 1 ? "list without the box"
                        : mistake == 6 ? "box for an open cloud"
                                       : "box of another length";
                switch (mistake) {
                case 0:
                    s.seen_box[axis] = 0.0;
                    break;
                case 1:
                    s.box[axis] = 0.0;
                    break;
                case 2:
                    s.seen_box[axis] = length + s.dx;
                    break;
                case 3:
                    s.seen_box[axis] = length - s.dx;
                    break;
                case 4:
                    s.seen_box[axis] = 2.0 * length;
                    break;
                case 5:
                    s.seen_box[axis] = 0.5 * length;
                    break;
                default:
                    s.box[0] = s.box[1] = s.box[2] = 0.0;
                    break;
                }
                scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
                f = expect(&s, BIT(SPH_FINDING_BOX), 0);
                if (f.set & BIT(SPH_FINDING_BOX)) { /* a pair for which the two boxes matter */
                    const sph_offender o = f.at[SPH_FINDING_BOX];
                    CHECK(fabs(distance(&s, o.particle, o.neighbour, s.box) -
                               distance(&s, o.particle, o.neighbour, s.seen_box)) > 1e-3 * s.dx);
                    CHECK_CLOSE((double)o.ratio,
                                distance(&s, o.particle, o.neighbour, s.seen_box) /
                                    ((double)sph_kernel_support_ratio(k) * (double)s.h[0]),
                                2e-4);
                    CHECK(o.ratio < SPH_R(1e-3) ||
                          listed(&s, o.particle, o.neighbour) == (o.ratio > SPH_R(1)));
                }
                scene_free(&s);
            }
}
static void check_volumes(int dim, sph_kernel k, int periodic)
{
    int a;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1) {
        scene s = block(k, dim, jitter_of[a], periodic, (uint64_t)(60 + a));
        const double right = (double)s.V[0];
        static const double density[5] = {1000.0, 2.0, 0.4, 1e-3, 1e6};
        sph_index i;
        sph_findings f;
        int c;
        label = "volumes never filled";
        for (i = 0; i < s.n; i++) s.V[i] = SPH_R(0);
        f = expect(&s, BIT(SPH_FINDING_VOLUME_ZERO), 0);
        CHECK(f.at[SPH_FINDING_VOLUME_ZERO].particle == 0 && f.at[SPH_FINDING_VOLUME_ZERO].neighbour == -1);
        label = "volumes filled for a third";
        for (i = 0; i < s.n / 3; i++) s.V[i] = SPH_R(right);
        f = expect(&s, BIT(SPH_FINDING_VOLUME_ZERO), 0);
        CHECK(f.at[SPH_FINDING_VOLUME_ZERO].particle == s.n / 3);
        label = "one is negative";
        for (i = 0; i < s.n; i++) s.V[i] = SPH_R(right);
        s.V[s.n / 2] = SPH_R(-right);
        f = expect(&s, BIT(SPH_FINDING_VOLUME_ZERO), 0);
        CHECK(f.at[SPH_FINDING_VOLUME_ZERO].particle == s.n / 2 &&
              f.at[SPH_FINDING_VOLUME_ZERO].ratio < SPH_R(0));
        label = "masses for volumes";
        for (c = 0; c < 5; c++) {
            for (i = 0; i < s.n; i++) s.V[i] = SPH_R(right * density[c]);
            f = expect(&s, BIT(SPH_FINDING_VOLUME_SUM), 0);
            CHECK_RELATIVE((double)f.at[SPH_FINDING_VOLUME_SUM].ratio, density[c], 0.6);
            CHECK(f.at[SPH_FINDING_VOLUME_SUM].neighbour == -1 && f.interior > 0 && f.interior <= f.sampled);
        }
        label = "masses of water and air for volumes";
        for (i = 0; i < s.n; i++)
            s.V[i] = SPH_R(right * ((double)s.x[0][i] < 0.5 * side_of(dim) * s.dx ? 1000.0 : 1.0));
        expect(&s, BIT(SPH_FINDING_VOLUME_SUM), 0);
        label = "one mass for all";
        {
            const sph_real mass = SPH_R(right * 800.0), nothing = SPH_R(0);
            s.cloud.volume = sph_scalars_same(&mass);
            expect(&s, BIT(SPH_FINDING_VOLUME_SUM), 0);
            s.cloud.volume = sph_scalars_same(&nothing);
            expect(&s, BIT(SPH_FINDING_VOLUME_ZERO), 0);
        }
        scene_free(&s);
    }
}
static void check_dim(int dim, sph_kernel k)
{
    int a, component, seen;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1) {
        scene s = block(k, dim, jitter_of[a], OPEN, (uint64_t)(70 + a));
        sph_findings f;
        label = "dim too low";
        for (seen = 1; seen < dim; seen++) {
            s.dim = seen;
            f = expect(&s, BIT(SPH_FINDING_DIM_LOW), 0);
            if (f.set & BIT(SPH_FINDING_DIM_LOW)) {
                const sph_offender o = f.at[SPH_FINDING_DIM_LOW];
                CHECK(o.neighbour == 0 && o.particle > 0 && o.ratio > SPH_R(0));
                CHECK(s.x[dim - 1][o.particle] < s.x[dim - 1][0] ||
                      s.x[dim - 1][o.particle] > s.x[dim - 1][0]);
            }
        }
        s.dim = dim;
        label = "dim too high";
        for (component = 0; component < dim && dim > 1; component++) {
            sph_real *const kept = s.x[component];
            sph_index i;
            s.x[component] = (sph_real *)cloud_memory((size_t)s.n, sizeof(sph_real));
            for (i = 0; i < s.n; i++) s.x[component][i] = SPH_R(0.25);
            scene_list(&s, SPH_GATHER, 1.0, 0.0, 0);
            f = expect(&s, BIT(SPH_FINDING_DIM_HIGH), 0);
            free(s.x[component]);
            s.x[component] = kept;
        }
        scene_free(&s);
    }
    if (dim > 1) { /* one layer; its kernel would be that of dim - 1 */
        scene s = block(k, dim - 1, 0.2, OPEN, 79);
        label = "one layer, dim too high";
        s.dim = dim;
        expect(&s, BIT(SPH_FINDING_DIM_HIGH), 0);
        scene_free(&s);
    }
}
static void check_stride(int dim, sph_kernel k, int periodic)
{
    int a;
    for (a = 0; a < 3; a += dim == 3 ? 2 : 1) {
        scene s = block(k, dim, jitter_of[a], periodic, (uint64_t)(80 + a));
        const size_t n = (size_t)s.n;
        pcg32 g;
        size_t i, c;
        /* interleaved, or structs of 8 numbers; and room for strides in bytes, filled with what may lie
           there */
        sph_real *const xyz = (sph_real *)cloud_memory(8 * 8 * n, sizeof *xyz);
        const sph_points right = s.cloud.points;
        sph_findings f;
        pcg32_seed(&g, 81, 1);
        for (i = 0; i < 64 * n; i++) xyz[i] = SPH_R(side_of(dim) * s.dx * pcg32_uniform(&g));
        for (i = 0; i < n; i++)
            for (c = 0; c < (size_t)dim; c++) xyz[i * 8 + c] = s.x[c][i];
        s.cloud.points = sph_points_strided(s.n, xyz, dim > 1 ? xyz + 1 : 0, dim > 2 ? xyz + 2 : 0, 8);
        s.cloud.points.box = right.box;
        healthy(&s);
        label = "member of a struct as an array"; /* in 1D nothing tells it from a list of other positions */
        s.cloud.points.stride = 1;
        f = expect(&s, dim > 1 ? BIT(SPH_FINDING_STRIDE) : BIT(SPH_FINDING_LIST_STALE), 0);
        if (dim > 1) CHECK_CLOSE((double)f.at[SPH_FINDING_STRIDE].ratio, 1.0, 0.0);
        label = "stride of another struct";
        s.cloud.points.stride = 7;
        expect(&s, BIT(SPH_FINDING_LIST_STALE), 0);
        label = "stride in bytes";
        s.cloud.points.stride = 8 * sizeof(sph_real);
        f = expect(&s, BIT(SPH_FINDING_STRIDE), 0);
        CHECK_CLOSE((double)f.at[SPH_FINDING_STRIDE].ratio, (double)sizeof(sph_real), 0.0);
        label = "interleaved as separate arrays";
        for (i = 0; i < n; i++)
            for (c = 0; c < (size_t)dim; c++) xyz[i * (size_t)dim + c] = s.x[c][i];
        if (dim > 1) {
            s.cloud.points.stride = 1;
            expect(&s, BIT(SPH_FINDING_STRIDE), 0);
            if (dim == 3) {
                s.cloud.points.stride = 2;
                expect(&s, BIT(SPH_FINDING_STRIDE), 0);
            }
            label = "x twice";
            s.cloud.points = right;
            s.cloud.points.y = right.x;
            expect(&s, BIT(SPH_FINDING_STRIDE), 0);
        }
        label = "interleaved, stride in bytes";
        s.cloud.points = sph_points_interleaved(s.n, dim, xyz);
        s.cloud.points.stride *= sizeof(sph_real);
        s.cloud.points.box = right.box;
        expect(&s, BIT(SPH_FINDING_STRIDE), 0);
        free(xyz);
        scene_free(&s);
    }
}

/* What sweeps refuse is refused here, and nothing is written; and whatever a list holds, nothing outside
   is read. */
static void check_errors(void)
{
    scene s = block(SPH_WENDLAND_C2, 2, 0.2, OPEN, 90);
    sph_findings f;
    sph_cloud c = s.cloud;
    const sph_real bad = SPH_R(0), nan_value = SPH_R(NAN);
    sph_index kept;
    pcg32 g;
    int round;
    f.set = 12345u;
#define REFUSED(error, k, dim, both) \
    CHECK(sph_cloud_examine(k, dim, c, both, 0, &f) == (error) && f.set == 12345u)
    REFUSED(SPH_ERROR_DIM, SPH_WENDLAND_C2, 0, 0);
    REFUSED(SPH_ERROR_DIM, SPH_WENDLAND_C2, 4, 0);
    REFUSED(SPH_ERROR_KERNEL, SPH_KERNEL_COUNT, 2, 0);
    REFUSED(SPH_ERROR_VALUE, SPH_WENDLAND_C2, 2, 16);
    CHECK(sph_cloud_examine(SPH_WENDLAND_C2, 2, c, 0, 0, 0) == SPH_ERROR_NULL);
    c.h = sph_scalars_none();
    REFUSED(SPH_ERROR_NULL, SPH_WENDLAND_C2, 2, 0);
    c.h = sph_scalars_same(&bad);
    REFUSED(SPH_ERROR_H, SPH_WENDLAND_C2, 2, 0);
    c = s.cloud;
    c.volume = sph_scalars_same(&nan_value);
    REFUSED(SPH_ERROR_VALUE, SPH_WENDLAND_C2, 2, 0);
    c = s.cloud;
    c.points.y = 0;
    REFUSED(SPH_ERROR_NULL, SPH_WENDLAND_C2, 2, 0);
    c = s.cloud;
    c.list.index = 0;
    REFUSED(SPH_ERROR_NULL, SPH_WENDLAND_C2, 2, 0);
    c = s.cloud;
    c.list.start = 0;
    REFUSED(SPH_ERROR_NULL, SPH_WENDLAND_C2, 2, 0);
    c = sph_cloud_range(s.cloud, 3, 2);
    REFUSED(SPH_ERROR_RANGE, SPH_WENDLAND_C2, 2, 0);
    c = sph_cloud_range(s.cloud, 0, s.n + 1);
    REFUSED(SPH_ERROR_RANGE, SPH_WENDLAND_C2, 2, 0);
    c = s.cloud;
    c.points.stride = 0;
    REFUSED(SPH_ERROR_COUNT, SPH_WENDLAND_C2, 2, 0);
    c.points.stride = 1;
    c.points.n = -1;
    REFUSED(SPH_ERROR_COUNT, SPH_WENDLAND_C2, 2, 0);
    c = s.cloud;
    c.points.box.x = SPH_R(-1);
    REFUSED(SPH_ERROR_BOX, SPH_WENDLAND_C2, 2, 0);
    c.points.box.x = SPH_R(1e-9);
    REFUSED(SPH_ERROR_BOX, SPH_WENDLAND_C2, 2, 0);
    c = s.cloud;
    s.x[1][7] = nan_value;
    REFUSED(SPH_ERROR_POSITION, SPH_WENDLAND_C2, 2, 0);
    scene_free(&s);
    s = block(SPH_WENDLAND_C2, 2, 0.2, OPEN, 90);
    c = s.cloud;
    kept = s.index[s.pairs / 2];
    s.index[s.pairs / 2] =
        s.n +
        1000; /* no particle; what it stood for is missing, too, but no sampled row lacks it, or one does */
    {
        const sph_index answer = sph_cloud_examine(SPH_WENDLAND_C2, 2, c, 0, 1, &f);
        CHECK(answer == SPH_ERROR_LIST);
    }
    s.index[s.pairs / 2] = kept;
    kept = s.start[5];
    s.start[5] = s.start[6] + 1;
    REFUSED(SPH_ERROR_LIST, SPH_WENDLAND_C2, 2, 0);
    s.start[5] = kept;
    s.start[0] = -1;
    REFUSED(SPH_ERROR_LIST, SPH_WENDLAND_C2, 2, 0);
    s.start[0] = 0;
    /* rows that hold their own particle, and are right otherwise */
    {
        sph_index *const with_self = (sph_index *)cloud_memory((size_t)(s.pairs + s.n), sizeof *with_self),
                         *const start = (sph_index *)cloud_memory((size_t)s.n + 1, sizeof *start);
        sph_index i, p, q = 0;
        for (i = 0; i < s.n; i++) {
            start[i] = q;
            with_self[q++] = i;
            for (p = s.start[i]; p < s.start[i + 1]; p++) with_self[q++] = s.index[p];
        }
        start[s.n] = q;
        c.list.start = start;
        c.list.index = with_self;
        REFUSED(SPH_ERROR_SELF, SPH_WENDLAND_C2, 2, 0);
        free(with_self);
        free(start);
    }
    /* a box that the support is too long for */
    c = s.cloud;
    c.points.box.x = SPH_R(100);
    CHECK(sph_cloud_examine(SPH_WENDLAND_C2, 2, c, 0, 0, &f) == 0);
    /* nonsense in the list: anything but a crash */
    c = s.cloud;
    pcg32_seed(&g, 99, 1);
    for (round = 0; round < 30; round++) {
        sph_index p, answer;
        for (p = 0; p < s.pairs; p++)
            if (pcg32_uniform(&g) < 0.03 * round)
                s.index[p] =
                    (sph_index)(2147483646.0 * cloud_symmetric(&g) * (pcg32_uniform(&g) < 0.5 ? 1.0 : 1e-7));
        answer = sph_cloud_examine(SPH_WENDLAND_C2, 2, c, round % 2, round, &f);
        CHECK(answer == SPH_ERROR_LIST || answer == SPH_ERROR_SELF || answer >= 0);
        if (round > 3) CHECK(answer != 0);
    }
    scene_free(&s);
    /* nothing */
    memset(&c, 0, sizeof c);
    CHECK(sph_cloud_examine(SPH_WENDLAND_C2, 3, c, 0, 0, &f) == 0 && f.set == 0u && f.sampled == 0);
}

/* Two mistakes that have nothing to do with each other are both found. */
static void check_two(int dim)
{
    scene s = block(SPH_WENDLAND_C2, dim, 0.2, OPEN, 100);
    sph_index i;
    label = "two mistakes";
    for (i = 0; i < s.n; i++) s.V[i] *= SPH_R(1000);
    scene_list(&s, SPH_GATHER, 1.0, 0.0, 1);
    expect(&s, BIT(SPH_FINDING_VOLUME_SUM) | BIT(SPH_FINDING_LIST_HALF), 0);
    for (i = 0; i < s.n; i++) s.V[i] = SPH_R(0);
    scene_list(&s, SPH_GATHER, 0.7, 0.0, 0);
    if (dim > 1) expect(&s, BIT(SPH_FINDING_VOLUME_ZERO) | BIT(SPH_FINDING_LIST_SHORT), 0);
    scene_free(&s);
}

static void check_texts(void)
{
    int a, b;
    for (a = 0; a < SPH_FINDING_COUNT; a++) {
        CHECK(strlen(sph_finding_text(a)) > 40);
        for (b = 0; b < a; b++) CHECK(strcmp(sph_finding_text(a), sph_finding_text(b)) != 0);
    }
    CHECK(strcmp(sph_finding_text(-1), sph_finding_text(SPH_FINDING_COUNT)) == 0);
}

int main(void)
{
    int dim, k;
    for (dim = 1; dim <= LAST_DIM; dim++) {
        for (k = 0; k < KERNELS; k++) {
            int periodic;
            check_healthy(dim, kernel_of[k]);
            check_healthy_adaptive(dim, kernel_of[k]);
            check_healthy_shapes(dim, kernel_of[k]);
            for (periodic = 0; periodic < 2; periodic++) {
                check_lists(dim, kernel_of[k], periodic);
                check_from_one(dim, kernel_of[k], periodic);
                check_volumes(dim, kernel_of[k], periodic);
                check_stride(dim, kernel_of[k], periodic);
            }
            check_one_sided(dim, kernel_of[k]);
            check_box(dim, kernel_of[k]);
            check_dim(dim, kernel_of[k]);
        }
        check_two(dim);
    }
    check_errors();
    check_texts();
    return check_report("test_doctor");
}
