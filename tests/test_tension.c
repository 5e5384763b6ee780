/* SPDX-License-Identifier: MIT */
/*
 * test_tension.c - surface tension: pair functions and sweeps beside sums by hand, what CSS conserves and CSF does not, the pressure in drops, flat interfaces, and Akinci's pair.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <string.h>

#define KERNEL SPH_WENDLAND_C2
#define EPSILON ((double)SPH_EPSILON)

static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }
static double square(double x) { return x * x; }

typedef struct drop {
    cloud c;
    sph_real *colour, *smooth, *rho, *h, *n[3], *a[3], *curvature;
    unsigned char *status;
} drop;

static drop drop_new(cloud c)
{
    drop d;
    sph_index i;
    int k;
    d.c = c;
    d.colour = (sph_real *)cloud_memory(11 * (size_t)c.n, sizeof *d.colour);
    d.smooth = d.colour + c.n;
    d.rho = d.smooth + c.n;
    d.h = d.rho + c.n;
    d.curvature = d.h + c.n;
    for (k = 0; k < 3; k++) {
        d.n[k] = d.curvature + (k + 1) * c.n;
        d.a[k] = d.curvature + (k + 4) * c.n;
    }
    d.status = (unsigned char *)cloud_memory((size_t)c.n, 1);
    for (i = 0; i < c.n; i++) {
        d.rho[i] = SPH_R(1);
        d.h[i] = c.h * SPH_R(1.0 - 0.05 * (i % 3));
    }
    return d;
}
static void drop_free(drop *d)
{
    cloud_free(&d->c);
    free(d->colour);
    free(d->status);
}
static sph_tension tension_of(const drop *d, double sigma)
{
    sph_tension t;
    t.rho = sph_scalars_array(d->rho);
    t.normal = sph_vectors_separate(d->n[0], d->n[1], d->n[2]);
    t.sigma = SPH_R(sigma);
    t.least = SPH_R(0);
    return t;
}
static sph_vector_out vectors_into(sph_real *const *a) { return sph_vector_out_separate(a[0], a[1], a[2]); }
static sph_tension_out into(const drop *d)
{
    sph_tension_out o;
    o.acceleration = vectors_into(d->a);
    o.curvature = d->curvature;
    o.stride = 1;
    o.status = d->status;
    return o;
}
static sph_cloud view(const drop *d, int own) { return sph_cloud_of(cloud_points(&d->c), cloud_list(&d->c), own ? sph_scalars_array(d->h) : cloud_h(&d->c), cloud_V(&d->c)); }
static void normals(drop *d, const sph_real *colour) { CHECK(sph_gradient_difference(KERNEL, d->c.dim, cloud_view(&d->c), sph_scalars_array(colour), vectors_into(d->n)) == 0); }
static void smooth(drop *d) { CHECK(sph_interpolate_shepard(KERNEL, d->c.dim, cloud_view(&d->c), sph_scalars_array(d->colour), sph_scalar_out_array(d->smooth, 0)) == 0); }
static int css(drop *d, double sigma) { return (int)sph_tension_css(KERNEL, d->c.dim, cloud_view(&d->c), tension_of(d, sigma), vectors_into(d->a)); }
static int csf(drop *d, double sigma) { return (int)sph_tension_csf(KERNEL, d->c.dim, cloud_view(&d->c), tension_of(d, sigma), into(d)); }

/* ---- the sweeps beside sums by hand, with random normals, volumes and densities ---- */

static void test_by_hand(void)
{
    int dim, own;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++) {
            static const int side[] = {0, 31, 11, 7};
            const double sigma = 0.7;
            drop d = drop_new(cloud_lattice(dim, side[dim], 1.4, 0.2, 3));
            double *const stress = (double *)cloud_memory((size_t)d.c.n, 9 * sizeof *stress), *const a_i = (double *)cloud_memory((size_t)d.c.n, 3 * sizeof *a_i);
            double worst = 0.0, size = 0.0, kappa_off = 0.0, kappa_size = 0.0, csf_off = 0.0, net[3] = {0.0, 0.0, 0.0}, all = 0.0;
            const double least = 0.01 / (double)d.c.h;
            pcg32 g;
            sph_index i, p;
            int k, l, skipped = 0;
            pcg32_seed(&g, 4, 4);
            cloud_random_volumes(&d.c, 9);
            for (i = 0; i < d.c.n; i++) {
                double s = 0.0;
                const double scale = i % 5 == 0 ? 0.1 * least : 1.0; /* some are too short to count */
                d.rho[i] = SPH_R(1.0 + 0.5 * cloud_symmetric(&g));
                for (k = 0; k < dim; k++) {
                    d.n[k][i] = SPH_R(scale * cloud_symmetric(&g));
                    s += square((double)d.n[k][i]);
                }
                s = sqrt(s);
                for (k = 0; k < dim; k++)
                    for (l = 0; l < dim; l++) stress[9 * i + 3 * k + l] = sigma * ((k == l ? s : 0.0) - (double)d.n[k][i] * (double)d.n[l][i] / s);
            }
            CHECK(sph_tension_css(KERNEL, dim, view(&d, own), tension_of(&d, sigma), vectors_into(d.a)) == 0);
            for (i = 0; i < d.c.n; i++) {
                double x[3], y[3], a[3] = {0.0, 0.0, 0.0};
                cloud_position(&d.c, i, x);
                for (p = d.c.start[i]; p < d.c.start[i + 1]; p++) {
                    const sph_index j = d.c.index[p];
                    const double h = own ? 0.5 * (double)(d.h[i] + d.h[j]) : (double)d.c.h;
                    double r = 0.0, F;
                    cloud_position(&d.c, j, y);
                    for (k = 0; k < dim; k++) r += square(x[k] - y[k]);
                    F = (double)sph_kernel_f(KERNEL, dim, SPH_R(sqrt(r)), SPH_R(h));
                    for (k = 0; k < dim; k++)
                        for (l = 0; l < dim; l++) a[k] += (double)d.c.V[j] / (double)d.rho[i] * (stress[9 * i + 3 * k + l] + stress[9 * j + 3 * k + l]) * F * (x[l] - y[l]);
                }
                for (k = 0; k < dim; k++) {
                    worst = worse(worst, a[k] - (double)d.a[k][i]);
                    size = worse(size, a[k]);
                    net[k] += (double)d.rho[i] * (double)d.c.V[i] * (double)d.a[k][i];
                    all += (double)d.rho[i] * (double)d.c.V[i] * fabs((double)d.a[k][i]);
                }
            }
            CHECK_WORST(check_words("CSS beside sums by hand in %dD", dim), worst, 200.0 * EPSILON * (size + 1.0));
            for (k = 0; k < dim; k++) CHECK_WORST(check_words("force of CSS on all in %dD", dim), net[k], 50.0 * EPSILON * (all + 1.0));
            if (dim > 1) CHECK(size > 1.0);
            CHECK(sph_tension_csf(KERNEL, dim, view(&d, own), tension_of(&d, sigma), into(&d)) == 0);
            for (i = 0; i < d.c.n; i++) {
                const double h = own ? (double)d.h[i] : (double)d.c.h, shortest = 0.01 / h;
                double x[3], y[3], flux = 0.0, weight = 0.0, kappa, si = 0.0;
                cloud_position(&d.c, i, x);
                for (k = 0; k < dim; k++) si += square((double)d.n[k][i]);
                si = sqrt(si);
                for (p = d.c.start[i]; p < d.c.start[i + 1]; p++) {
                    const sph_index j = d.c.index[p];
                    double r = 0.0, F, sj = 0.0;
                    cloud_position(&d.c, j, y);
                    for (k = 0; k < dim; k++) {
                        r += square(x[k] - y[k]);
                        sj += square((double)d.n[k][j]);
                    }
                    sj = sqrt(sj);
                    if (sj <= shortest) continue;
                    F = (double)sph_kernel_f(KERNEL, dim, SPH_R(sqrt(r)), SPH_R(h));
                    weight -= (double)d.c.V[j] * F * r;
                    for (k = 0; k < dim; k++) flux += (double)d.c.V[j] * F * ((double)d.n[k][j] / sj - (double)d.n[k][i] / si) * (x[k] - y[k]);
                }
                kappa = si > shortest ? -dim * flux / weight : 0.0;
                skipped += si <= shortest;
                kappa_off = worse(kappa_off, kappa - (double)d.curvature[i]);
                kappa_size = worse(kappa_size, kappa);
                for (k = 0; k < dim; k++) csf_off = worse(csf_off, (double)d.a[k][i] - sigma * (double)d.curvature[i] * (double)d.n[k][i] / (double)d.rho[i]);
                CHECK_SAME("status of CSF", i, d.status[i], SPH_OK);
            }
            CHECK(skipped > 0 && kappa_size > 1.0);
            CHECK_WORST(check_words("curvature beside sums by hand in %dD", dim), kappa_off, 500.0 * EPSILON * kappa_size);
            CHECK_WORST(check_words("CSF beside its formula in %dD", dim), csf_off, 20.0 * EPSILON * kappa_size);
            free(stress);
            free(a_i);
            drop_free(&d);
        }
}

/* ---- a linear field of unit normals cannot be; but the divisor makes kappa exact for what is linear: pair by pair ---- */

static void test_divisor(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        sph_curvature_sums s;
        sph_unit_normal i, j;
        pcg32 g;
        int k;
        s.flux = s.weight = SPH_R(0);
        memset(&i, 0, sizeof i);
        memset(&j, 0, sizeof j);
        i.good = j.good = SPH_R(1);
        pcg32_seed(&g, 8, 8);
        for (k = 0; k < 9; k++) { /* u = 0.3 x */
            sph_vec x;
            sph_curvature_sums c;
            x.x = SPH_R(cloud_symmetric(&g));
            x.y = SPH_R(dim > 1 ? cloud_symmetric(&g) : 0.0);
            x.z = SPH_R(dim > 2 ? cloud_symmetric(&g) : 0.0);
            j.unit = sph_scale(SPH_R(-0.3), x);
            c = sph_curvature_pair(dim, i, j, SPH_R(0.5 + k), x, SPH_R(-1.0 - 0.1 * k));
            s.flux += c.flux;
            s.weight += c.weight;
        }
        CHECK_CLOSE((double)sph_curvature_value(dim, s), -0.3 * dim, 50.0 * EPSILON);
    }
}

/* ---- drops: the table of the header, within 0.01 ---- */

typedef struct measured {
    double jump, rms, net, total; /* the jump over sigma / R (3D: 2 sigma / R), rms of R kappa - 1, force on all over the sum of magnitudes, and that sum */
} measured;
static measured measure(const drop *d, double radius)
{
    const int dim = d->c.dim;
    measured m = {0.0, 0.0, 0.0, 0.0};
    double f[3] = {0.0, 0.0, 0.0}, weight = 0.0;
    const double whole = dim == 2 ? 2.0 * PI : 8.0 * PI * radius;
    sph_index i;
    int k;
    for (i = 0; i < d->c.n; i++) {
        double x[3], r = 0.0, in = 0.0, a = 0.0, n = 0.0;
        cloud_position(&d->c, i, x);
        for (k = 0; k < dim; k++) {
            r += square(x[k] - 0.5);
            in -= (double)d->a[k][i] * (x[k] - 0.5);
            a += square((double)d->a[k][i]);
            n += square((double)d->n[k][i]);
            f[k] += (double)d->c.V[i] * (double)d->a[k][i];
        }
        if (r > 0.0) m.jump += (double)d->c.V[i] * in / sqrt(r) / whole;
        m.total += (double)d->c.V[i] * sqrt(a) / whole;
        if (d->curvature[i] < SPH_R(0) || d->curvature[i] > SPH_R(0)) {
            weight += sqrt(n);
            m.rms += sqrt(n) * square((double)d->curvature[i] * radius / (dim - 1) - 1.0);
        }
    }
    m.net = sqrt(square(f[0]) + square(f[1]) + square(f[2])) / whole / m.total;
    m.rms = weight > 0.0 ? sqrt(m.rms / weight) : 0.0;
    return m;
}
static drop disc(int dim, int cells, double jitter, double *radius)
{
    const int side = 2 * (cells + (dim == 2 ? 10 : 6)) + 1;
    drop d = drop_new(cloud_lattice(dim, side, 2.0, jitter, 7));
    double inside = 0.0;
    sph_index i;
    for (i = 0; i < d.c.n; i++) {
        double x[3], r = 0.0;
        int k;
        cloud_position(&d.c, i, x);
        for (k = 0; k < dim; k++) r += square(x[k] - 0.5);
        d.c.V[i] = SPH_R(pow(d.c.dx, dim));
        d.colour[i] = SPH_R(r < square((cells + 0.1) * d.c.dx)); /* no particle lies on the rim */
        inside += (double)(d.colour[i] * d.c.V[i]);
    }
    *radius = dim == 2 ? sqrt(inside / PI) : cbrt(0.75 * inside / PI);
    return d;
}
static void test_drops(void)
{
    static const double by_css[] = {0.983, 0.991, 0.991}, by_csf[] = {1.03, 1.02, 1.02}, scatter[] = {0.27, 0.45, 1.16};
    double radius;
    measured m;
    int k;
    for (k = 0; k < 3; k++) {
        drop d = disc(2, 8 << k, 0.0, &radius);
        normals(&d, d.colour);
        CHECK(css(&d, 1.0) == 0);
        CHECK_CLOSE(measure(&d, radius).jump, by_css[k], 0.01);
        smooth(&d);
        normals(&d, d.smooth);
        CHECK(csf(&d, 1.0) == 0);
        m = measure(&d, radius);
        CHECK_CLOSE(m.jump, by_csf[k], 0.01);
        CHECK_CLOSE(m.rms, scatter[k], 0.1 * scatter[k]);
        drop_free(&d);
    }
    for (k = 0; k < 2; k++) { /* disturbed: the force on all together, and its control */
        drop d = disc(2, 8 << k, 0.2, &radius);
        normals(&d, d.colour);
        CHECK(css(&d, 1.0) == 0);
        m = measure(&d, radius);
        CHECK_CLOSE(m.net, 0.0, 50.0 * EPSILON);
        CHECK_CLOSE(m.jump, 1.0, 0.06);
        smooth(&d);
        normals(&d, d.smooth);
        CHECK(csf(&d, 1.0) == 0);
        m = measure(&d, radius);
        CHECK(m.net > 1e-3);
        CHECK_CLOSE(m.jump, 1.0, 0.08);
        drop_free(&d);
    }
    {
        drop d = disc(3, 7, 0.0, &radius);
        normals(&d, d.colour);
        CHECK(css(&d, 1.0) == 0);
        CHECK_CLOSE(measure(&d, radius).jump, 1.0, 0.05);
        smooth(&d);
        normals(&d, d.smooth);
        CHECK(csf(&d, 1.0) == 0);
        CHECK_CLOSE(measure(&d, radius).jump, 1.0, 0.08);
        drop_free(&d);
    }
}

/* ---- what there is no force from: a flat interface, one fluid alone; and c against 1 - c ---- */

static void test_flat(void)
{
    drop d = drop_new(cloud_lattice(2, 25, 2.0, 0.0, 1));
    double off = 0.0, bent = 0.0;
    sph_index i;
    int k, both;
    for (i = 0; i < d.c.n; i++) {
        d.c.V[i] = SPH_R(square(d.c.dx));
        d.colour[i] = SPH_R((double)d.c.x[i] < 0.51);
    }
    for (both = 0; both < 2; both++) {
        normals(&d, d.colour);
        CHECK((both ? csf(&d, 1.0) : css(&d, 1.0)) == 0);
        for (i = 0; i < d.c.n; i++) /* away from the ends, where the support is cut */
            if (fabs((double)d.c.y[i] - 0.5) < 0.29)
                for (k = 0; k < 2; k++) off = worse(off, (double)d.a[k][i]);
        for (i = 0; i < d.c.n; i++) bent = worse(bent, (double)d.a[1][i]);
    }
    CHECK_WORST("force of a flat interface, times h^2 / sigma", off * square((double)d.c.h), 1e-3);
    CHECK(bent * square((double)d.c.h) > 1e-2); /* negative control: at the ends it is there */
    for (i = 0; i < d.c.n; i++) d.colour[i] = SPH_R(1);
    normals(&d, d.colour);
    for (both = 0; both < 2; both++) {
        CHECK((both ? csf(&d, 1.0) : css(&d, 1.0)) == 0);
        for (i = 0; i < d.c.n; i++) CHECK_NEAR("force in one fluid", i, d.a[0][i], 0.0, 0.0);
    }
    drop_free(&d);
}
static void test_exchange(void)
{
    double radius;
    drop d = disc(2, 8, 0.2, &radius);
    sph_real *const before = (sph_real *)cloud_memory((size_t)d.c.n, sizeof *before);
    sph_index i;
    int both;
    for (both = 0; both < 2; both++) {
        double off = 0.0, size = 0.0;
        normals(&d, d.colour);
        CHECK((both ? csf(&d, 1.0) : css(&d, 1.0)) == 0);
        memcpy(before, d.a[0], (size_t)d.c.n * sizeof *before);
        for (i = 0; i < d.c.n; i++) d.colour[i] = SPH_R(1) - d.colour[i];
        normals(&d, d.colour);
        CHECK((both ? csf(&d, 1.0) : css(&d, 1.0)) == 0);
        for (i = 0; i < d.c.n; i++) {
            off = worse(off, (double)(before[i] - d.a[0][i]));
            size = worse(size, (double)before[i]);
        }
        CHECK(size > 0.0);
        CHECK_WORST("force where the fluids exchange their names", off, 50.0 * EPSILON * size);
    }
    free(before);
    drop_free(&d);
}
/* a normal that counts, and no neighbour whose normal does */
static void test_alone(void)
{
    drop d = drop_new(cloud_lattice(2, 9, 1.5, 0.0, 1));
    sph_index i;
    d.n[0][40] = SPH_R(3);
    CHECK(csf(&d, 1.0) == 1);
    for (i = 0; i < d.c.n; i++) {
        CHECK_SAME("status", i, d.status[i], i == 40 ? SPH_TOO_FEW : SPH_OK);
        CHECK_NEAR("acceleration", i, d.a[0][i], 0.0, 0.0);
    }
    drop_free(&d);
}

/* ---- Akinci's pair ---- */

static void test_akinci(void)
{
    const sph_fluid_side i = {SPH_R(0.5), SPH_R(900), SPH_R(0), SPH_R(0)}, j = {SPH_R(0.5), SPH_R(1100), SPH_R(0), SPH_R(0)};
    const sph_vec x = {SPH_R(0.3), SPH_R(-0.4), SPH_R(0)}, back = {SPH_R(-0.3), SPH_R(0.4), SPH_R(0)}, n = {SPH_R(1), SPH_R(2), SPH_R(-3)}, nback = {SPH_R(-1), SPH_R(-2), SPH_R(3)};
    const sph_real r = SPH_R(0.5), support = SPH_R(0.8);
    const sph_vec a = sph_tension_pair_akinci(i, j, x, n, r, support, SPH_R(100)), b = sph_tension_pair_akinci(j, i, back, nback, r, support, SPH_R(100));
    /* by hand: 2 rho0 gamma / (rho_i + rho_j) = 0.1; C(r) for r > support / 2 = 32 / (pi H^9) (H - r)^3 r^3 */
    const double C = 32.0 / (PI * pow(0.8, 9.0)) * pow(0.3 * 0.5, 3.0);
    CHECK_CLOSE((double)a.x, -0.1 * (0.5 * C * 0.6 + 1.0), 20.0 * EPSILON);
    CHECK_CLOSE((double)a.y, -0.1 * (-0.5 * C * 0.8 + 2.0), 20.0 * EPSILON);
    CHECK_CLOSE((double)a.z, 0.3, 20.0 * EPSILON);
    CHECK_CLOSE((double)(a.x + b.x), 0.0, 4.0 * EPSILON);
    CHECK_CLOSE((double)(a.y + b.y), 0.0, 4.0 * EPSILON);
    CHECK_CLOSE((double)(a.z + b.z), 0.0, 4.0 * EPSILON);
    CHECK((double)sph_cohesion_kernel_akinci(SPH_R(0), support) < 0.0);
    CHECK((double)sph_cohesion_kernel_akinci(support, support) == 0.0);
    CHECK_RELATIVE((double)sph_cohesion_kernel_akinci(SPH_R(0.4 - 1e-7), support), (double)sph_cohesion_kernel_akinci(SPH_R(0.4 + 1e-7), support), 1e-6);
}

int main(void)
{
    test_by_hand();
    test_divisor();
    test_drops();
    test_flat();
    test_exchange();
    test_alone();
    test_akinci();
    return check_report("test_tension");
}
