/* SPDX-License-Identifier: MIT */
/*
 * test_liquid.c - density diffusion, free surfaces, shifting and the transport velocity: sums by hand, what they conserve, what they are exact for, and how well surfaces are found.
 *
 * tests/test_liquid_flow.c has what needs a flow. Kernel and dimension are run-time values here: one compiled instance of each operator serves all tests.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

#define KERNEL SPH_WENDLAND_C2
#define EPSILON ((double)SPH_EPSILON)

/* ---- a cloud with a state: its masses are V rho ---- */

typedef struct liquid {
    cloud c;
    sph_points x; /* periodic or open */
    sph_real *h, *m, *rho, *share, *v[3], *u[3], *a[3], *b[3], *g[3], *out;
    unsigned char *status;
} liquid;

static void lists(liquid *l, double radius)
{
    const sph_real reach = SPH_R(radius);
    const size_t size = sph_search_size(l->c.dim, l->c.n, (int64_t)l->c.n * 400);
    void *const memory = cloud_memory(size, 1);
    sph_neighbors found;
    sph_index i;
    if (sph_search(l->c.dim, l->x, sph_scalars_same(&reach), SPH_GATHER, memory, size, &found) != 0) abort();
    memcpy(l->c.start, found.list.start, ((size_t)l->c.n + 1) * sizeof *l->c.start);
    free(l->c.index);
    l->c.index = (sph_index *)cloud_memory((size_t)found.list.start[l->c.n], sizeof *l->c.index);
    for (i = 0; i < found.list.start[l->c.n]; i++) l->c.index[i] = found.list.index[i];
    free(memory);
}
static liquid liquid_of(cloud c, uint64_t seed)
{
    liquid l;
    const size_t n = (size_t)c.n;
    sph_real *next;
    pcg32 g;
    sph_index i;
    int k;
    memset(&l, 0, sizeof l);
    l.c = c;
    l.h = next = (sph_real *)cloud_memory(20 * n, sizeof *next);
    l.m = next += n;
    l.rho = next += n;
    l.share = next += n;
    for (k = 0; k < 3; k++) {
        l.v[k] = next += n;
        l.u[k] = next += n;
        l.a[k] = next += n;
        l.b[k] = next += n;
        l.g[k] = next += n;
    }
    l.out = next += n;
    l.status = (unsigned char *)cloud_memory(n, 1);
    pcg32_seed(&g, seed, 5);
    for (i = 0; i < c.n; i++) {
        l.h[i] = c.h * SPH_R(0.85 + 0.15 * pcg32_uniform(&g));
        l.rho[i] = SPH_R(1.0 + 0.2 * cloud_symmetric(&g));
        l.m[i] = l.rho[i] * c.V[i];
        l.share[i] = SPH_R(pcg32_uniform(&g) < 0.7);
        for (k = 0; k < 3; k++) {
            l.v[k][i] = SPH_R(k < c.dim ? cloud_symmetric(&g) : 0.0);
            l.u[k][i] = SPH_R(k < c.dim ? cloud_symmetric(&g) : 0.0);
        }
    }
    l.x = cloud_points(&l.c);
    return l;
}
static void liquid_free(liquid *l)
{
    cloud_free(&l->c);
    free(l->h);
    free(l->status);
}
/* side^dim particles in a periodic unit box, moved by up to jitter dx along each axis */
static liquid liquid_periodic(int dim, int side, double h_over_dx, double jitter, uint64_t seed)
{
    const double dx = 1.0 / side;
    const sph_index n = (sph_index)(dim == 1 ? side : dim == 2 ? side * side : side * side * side);
    cloud c = cloud_new(dim, n);
    liquid l;
    pcg32 g;
    sph_index i;
    pcg32_seed(&g, seed, 7);
    c.dx = dx;
    c.h = SPH_R(h_over_dx * dx);
    for (i = 0; i < n; i++) {
        c.x[i] = SPH_R((i % side + 0.5 + jitter * cloud_symmetric(&g)) * dx);
        c.y[i] = SPH_R((i / side % side + 0.5 + jitter * cloud_symmetric(&g)) * dx);
        c.z[i] = SPH_R((i / side / side + 0.5 + jitter * cloud_symmetric(&g)) * dx);
        c.V[i] = SPH_R(pow(dx, dim));
    }
    l = liquid_of(c, seed);
    l.x = sph_points_periodic(l.x, SPH_R(1), SPH_R(1), SPH_R(1));
    lists(&l, 2.0 * h_over_dx * dx);
    return l;
}
static sph_vectors three(sph_real *const *v) { return sph_vectors_separate(v[0], v[1], v[2]); }
static sph_vector_out to(sph_real *const *v) { return sph_vector_out_separate(v[0], v[1], v[2]); }
static sph_cloud view(const liquid *l, int own)
{
    return sph_cloud_of(l->x, cloud_list(&l->c), own ? sph_scalars_array(l->h) : cloud_h(&l->c), cloud_V(&l->c));
}
static sph_fluid fluid(const liquid *l, int moving)
{
    sph_fluid f = {0};
    f.m = sph_scalars_array(l->m);
    f.rho = sph_scalars_array(l->rho);
    if (moving) f.v = three(l->v);
    return f;
}
static const sph_tait water = {SPH_R(1), SPH_R(10), SPH_R(7), SPH_R(0)};
static sph_diffusion diffusion(const liquid *l, int shared) /* of a liquid at rest */
{
    sph_diffusion d = {0};
    d.fluid = fluid(l, 0);
    d.tait = water;
    d.gravity.x = SPH_R(0.3);
    d.gravity.y = SPH_R(-1);
    d.gravity.z = SPH_R(0.2);
    d.gradient = three(l->g);
    if (shared) d.share = sph_scalars_array(l->share);
    return d;
}
enum { MOLTENI, ANTUONO, FOURTAKAS, FORMS };
static const char *const form_names[] = {"molteni", "antuono", "fourtakas"};
static void rates(int form, const liquid *l, int own, int moving, sph_diffusion d)
{
    const sph_cloud all = view(l, own);
    const sph_scalar_out out = sph_scalar_out_array(l->out, l->status);
    const int dim = l->c.dim;
    d.fluid = fluid(l, moving);
    CHECK((form == MOLTENI   ? sph_density_diffusion_molteni(KERNEL, dim, all, d, out)
           : form == ANTUONO ? sph_density_diffusion_antuono(KERNEL, dim, all, d, out)
                             : sph_density_diffusion_fourtakas(KERNEL, dim, all, d, out)) == 0);
}
static void gradient(liquid *l, int own)
{
    const sph_derivatives_out out = {.gx = l->g[0], .gy = l->g[1], .gz = l->g[2]};
    CHECK(sph_gradient_cspm(KERNEL, l->c.dim, view(l, own), sph_scalars_array(l->rho), out) == 0);
}
/* x_i - x_j of the nearest image, and its length */
static double apart(const liquid *l, sph_index i, sph_index j, double *d)
{
    const double box[3] = {(double)l->x.box.x, (double)l->x.box.y, (double)l->x.box.z};
    double xi[3], xj[3], r2 = 0.0;
    int k;
    cloud_position(&l->c, i, xi);
    cloud_position(&l->c, j, xj);
    for (k = 0; k < 3; k++) {
        d[k] = xi[k] - xj[k];
        if (box[k] > 0.0) d[k] -= box[k] * floor(d[k] / box[k] + 0.5);
        r2 += d[k] * d[k];
    }
    return sqrt(r2);
}
static const int sides[] = {0, 41, 13, 8};
static double pair_h(const liquid *l, int own, sph_index i, sph_index j)
{
    return own ? 0.5 * ((double)l->h[i] + (double)l->h[j]) : (double)l->c.h;
}
static double pair_f(const liquid *l, double r, double h)
{
    return (double)sph_kernel_f(KERNEL, l->c.dim, SPH_R(r), SPH_R(h));
}

/* ---- density diffusion ---- */

static void test_diffusion_by_hand(void)
{
    int dim, own, open, form, moving, shared;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (open = 0; open < 2; open++) {
                liquid l = open ? liquid_of(cloud_lattice(dim, sides[dim], 1.3, 0.25, 3), 4)
                                : liquid_periodic(dim, sides[dim], 1.3, 0.25, 3);
                sph_index i, p;
                gradient(&l, own);
                for (form = 0; form < FORMS; form++)
                    for (moving = 0; moving < 2; moving++)
                        for (shared = 0; shared < 2; shared++) {
                            const sph_diffusion d = diffusion(&l, shared);
                            double worst = 0.0, size = 0.0, sum = 0.0, all = 0.0, heat = 0.0;
                            rates(form, &l, own, moving, d);
                            for (i = 0; i < l.c.n; i++) {
                                double expected = 0.0, x[3];
                                for (p = l.c.start[i]; p < l.c.start[i + 1]; p++) {
                                    const sph_index j = l.c.index[p];
                                    const double r = apart(&l, i, j, x), h = pair_h(&l, own, i, j), F = pair_f(&l, r, h),
                                                 V = (double)l.m[j] / (double)l.rho[j], drho = (double)l.rho[j] - (double)l.rho[i];
                                    const double gravity[3] = {(double)d.gravity.x, (double)d.gravity.y, (double)d.gravity.z};
                                    double psi = 2.0 * drho, vx = 0.0;
                                    int k;
                                    for (k = 0; k < dim; k++) {
                                        if (form == ANTUONO) psi += ((double)l.g[k][i] + (double)l.g[k][j]) * x[k];
                                        if (form == FOURTAKAS) psi += 2.0 * gravity[k] * x[k] / 100.0;
                                        vx += ((double)l.v[k][i] - (double)l.v[k][j]) * x[k];
                                    }
                                    if (shared) psi *= (double)l.share[i] * (double)l.share[j];
                                    expected += 0.1 * 10.0 * h * psi * V * -F;
                                    if (moving) expected += (double)l.rho[i] * V * vx * F;
                                }
                                worst = fmax(worst, fabs(expected - (double)l.out[i]));
                                size = fmax(size, fabs(expected));
                                sum += (double)l.m[i] / (double)l.rho[i] * (double)l.out[i];
                                all += fabs((double)l.m[i] / (double)l.rho[i] * (double)l.out[i]);
                                heat += (double)l.m[i] * (double)l.out[i];
                            }
                            CHECK(size > 0.01);
                            CHECK_WORST(check_words("%s in %dD beside sums by hand", form_names[form], dim), worst, 200.0 * EPSILON * size);
                            if (!moving) {
                                CHECK_WORST(check_words("%s in %dD: sum of V D", form_names[form], dim), sum, 20.0 * EPSILON * all);
                                if (form == MOLTENI) CHECK(heat < -1e-3 * all); /* it only takes */
                            }
                        }
                { /* Molteni & Colagrossi's as rows, and as a Laplacian */
                    const sph_real delta = SPH_R(0.1);
                    sph_real *const row = (sph_real *)cloud_memory((size_t)l.c.start[l.c.n], sizeof *row);
                    double off = 0.0, off_laplacian = 0.0, size = 0.0;
                    for (i = 0; i < l.c.n; i++) l.c.V[i] = l.m[i] / l.rho[i];
                    for (shared = 0; shared < 2; shared++) {
                        rates(MOLTENI, &l, own, 0, diffusion(&l, shared));
                        CHECK(sph_density_diffusion_rows_molteni(KERNEL, dim, view(&l, own), diffusion(&l, shared),
                                                                 (sph_rows_out){.row = row, .diagonal = l.a[0]}) == 0);
                        CHECK(sph_rows_apply(view(&l, own), row, sph_scalars_array(l.a[0]), sph_scalars_array(l.rho), sph_scalar_out_array(l.a[1], 0)) == 0);
                        CHECK(sph_laplacian_brookshaw(KERNEL, dim, view(&l, 0), sph_scalars_array(l.rho), sph_scalar_out_array(l.a[2], 0)) == 0);
                        for (i = 0; i < l.c.n; i++) {
                            size = fmax(size, fabs((double)l.out[i]));
                            off = fmax(off, fabs((double)l.out[i] - (double)l.a[1][i]));
                            if (!own && !shared)
                                off_laplacian = fmax(off_laplacian, fabs((double)l.out[i] - (double)(delta * water.c * l.c.h * l.a[2][i])));
                        }
                    }
                    CHECK_WORST(check_words("rows in %dD", dim), off, 200.0 * EPSILON * size);
                    CHECK_WORST(check_words("Brookshaw's Laplacian in %dD", dim), off_laplacian, 200.0 * EPSILON * size);
                    free(row);
                }
                liquid_free(&l);
            }
}

/* Antuono's D is 0 for every linear density, at boundaries too; Fourtakas's for that of a liquid at rest, and no other; Molteni & Colagrossi's for none */
static void test_diffusion_linear(void)
{
    int dim, own, form, rest, k;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (rest = 0; rest < 2; rest++) {
                liquid l = liquid_of(cloud_lattice(dim, sides[dim], 1.4, 0.25, 5), 6);
                const sph_diffusion d = diffusion(&l, 0);
                const sph_vec slope = sph_density_slope(water, d.gravity);
                const double s[3] = {rest ? (double)slope.x : 0.02, rest ? (double)slope.y : 0.01, rest ? (double)slope.z : -0.01};
                double worst[FORMS] = {0, 0, 0};
                sph_index i;
                for (i = 0; i < l.c.n; i++) {
                    double x[3];
                    cloud_position(&l.c, i, x);
                    l.rho[i] = SPH_R(1.0);
                    for (k = 0; k < dim; k++) l.rho[i] += SPH_R(s[k] * x[k]);
                }
                gradient(&l, own);
                for (form = 0; form < FORMS; form++) {
                    rates(form, &l, own, 0, d);
                    for (i = 0; i < l.c.n; i++) worst[form] = fmax(worst[form], fabs((double)l.out[i]));
                }
                CHECK(worst[MOLTENI] > 1e-4);
                CHECK_WORST(check_words("antuono for a linear density in %dD", dim), worst[ANTUONO], BY_PRECISION(1e-11, 3e-3) * worst[MOLTENI]);
                if (rest) CHECK_WORST(check_words("fourtakas for a liquid at rest in %dD", dim), worst[FOURTAKAS], BY_PRECISION(1e-11, 3e-3) * worst[MOLTENI]);
                else CHECK(worst[FOURTAKAS] > 0.5 * worst[MOLTENI]);
                liquid_free(&l);
            }
}

/* in the step a checkerboard becomes weaker, where the particles are even; in jitter 0.6 of it do, because some neighbours are nearer. In three
   steps at once it grows */
static void test_diffusion_step(void)
{
    int dim, jittered, n;
    CHECK_RELATIVE((double)sph_time_step_density_diffusion(KERNEL, 2, SPH_R(0.1), SPH_R(0.1), SPH_R(2)), 0.1 / (7.0 * 0.1 * 2.0), 1e-3);
    CHECK((double)sph_time_step_density_diffusion(KERNEL, 2, SPH_R(0.1), SPH_R(0), SPH_R(2)) > 1e17);
    for (dim = 1; dim <= 3; dim++)
        for (jittered = 0; jittered < 2; jittered++) {
            static const int even[] = {0, 40, 16, 10};
            liquid l = liquid_periodic(dim, even[dim], 2.0, jittered ? 0.2 : 0.0, 8);
            const double step = (double)sph_time_step_density_diffusion(KERNEL, dim, l.c.h, SPH_R(0.1), water.c);
            double range[2];
            CHECK(step > (double)sph_time_step_sound(l.c.h, water.c, SPH_R(0)));
            for (n = 0; n < 2; n++) {
                const double factor = n ? 3.0 : jittered ? 0.6 : 1.0;
                sph_index i;
                int k;
                for (i = 0; i < l.c.n; i++) l.rho[i] = SPH_R(1.0 + 0.001 * ((i + i / even[dim] + i / even[dim] / even[dim]) % 2 ? 1 : -1));
                for (k = 0; k < 6; k++) {
                    for (i = 0; i < l.c.n; i++) l.m[i] = l.rho[i] * l.c.V[i];
                    rates(MOLTENI, &l, 0, 0, diffusion(&l, 0));
                    for (i = 0; i < l.c.n; i++) l.rho[i] += SPH_R(factor * step * (double)l.out[i]);
                    range[n] = 0.0;
                    for (i = 0; i < l.c.n; i++) range[n] = fmax(range[n], fabs((double)l.rho[i] - 1.0));
                    if (!n) CHECK(range[n] <= 0.001 * (1.0 + 1e3 * EPSILON));
                }
            }
            CHECK(range[1] > 0.01);
            liquid_free(&l);
        }
}

/* ---- shifting: sums by hand, what is conserved, what is exact ---- */

static void test_shift_by_hand(void)
{
    int dim, own, tensile;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (tensile = 0; tensile < 2; tensile++) {
                liquid l = liquid_periodic(dim, sides[dim], 1.3, 0.25, 11);
                const sph_real strength = SPH_R(0.4) * l.c.h * l.c.h;
                sph_shift s = {0};
                double worst = 0.0, size = 0.0, total[3] = {0, 0, 0}, all = 0.0;
                sph_index i, p;
                int k;
                s.strength = sph_scalars_same(&strength);
                s.tensile = SPH_R(tensile ? 0.2 : 0.0);
                s.spacing = SPH_R(1.0 / 1.3);
                s.longest = SPH_R(-1);
                CHECK(sph_shift_displacement(KERNEL, dim, view(&l, own), s, to(l.a)) == 0);
                for (i = 0; i < l.c.n; i++) {
                    double g[3] = {0, 0, 0}, x[3];
                    for (p = l.c.start[i]; p < l.c.start[i + 1]; p++) {
                        const sph_index j = l.c.index[p];
                        const double r = apart(&l, i, j, x), h = pair_h(&l, own, i, j), F = pair_f(&l, r, h),
                                     w = (double)sph_kernel_w(KERNEL, dim, SPH_R(r), SPH_R(h)) / (double)sph_kernel_w(KERNEL, dim, SPH_R(h / 1.3), SPH_R(h));
                        for (k = 0; k < dim; k++) g[k] += (double)l.c.V[j] * (1.0 + (tensile ? 0.2 * pow(w, 4.0) : 0.0)) * F * x[k];
                    }
                    for (k = 0; k < dim; k++) {
                        worst = fmax(worst, fabs(-(double)strength * g[k] - (double)l.a[k][i]));
                        size = fmax(size, fabs((double)l.a[k][i]));
                        total[k] += (double)l.c.V[i] * (double)l.a[k][i];
                        all += fabs((double)l.c.V[i] * (double)l.a[k][i]);
                    }
                }
                CHECK_WORST(check_words("shift in %dD beside sums by hand", dim), worst, 300.0 * EPSILON * size);
                for (k = 0; k < dim; k++) CHECK_WORST(check_words("sum of V dx in %dD", dim), total[k], 20.0 * EPSILON * all);
                s.longest = SPH_R(0); /* 0.2 h, which is far below here, and then 1 % of what was found */
                for (k = 0; k < 2; k++) {
                    const double most = k ? 0.01 * size : 0.2 * (double)l.c.h;
                    if (k) s.longest = SPH_R(most);
                    CHECK(sph_shift_displacement(KERNEL, dim, view(&l, own), s, to(l.b)) == 0);
                    for (i = 0; i < l.c.n; i++) {
                        double b = 0.0, a = 0.0, along = 0.0;
                        int c;
                        for (c = 0; c < dim; c++) {
                            a += pow((double)l.a[c][i], 2.0);
                            b += pow((double)l.b[c][i], 2.0);
                            along += (double)l.a[c][i] * (double)l.b[c][i];
                        }
                        CHECK_AT("the longest shift", i, sqrt(b) <= most * (1.0 + 8.0 * EPSILON));
                        CHECK_AT("the limit does not turn it", i, along >= sqrt(a * b) * (1.0 - 16.0 * EPSILON));
                    }
                }
                liquid_free(&l);
            }
}
/* a lattice does not move; at a free surface the shift points outward, until it is told of the surface */
static void test_shift_at_a_surface(void)
{
    int dim, k;
    for (dim = 1; dim <= 3; dim++) {
        static const int even[] = {0, 40, 16, 10};
        liquid l = liquid_periodic(dim, even[dim], 1.3, 0.0, 12);
        const sph_real strength = SPH_R(0.4) * l.c.h * l.c.h;
        sph_shift s = {0};
        sph_real *lambda;
        sph_index i;
        int outward = 0, along = 0;
        s.strength = sph_scalars_same(&strength);
        CHECK(sph_shift_displacement(KERNEL, dim, view(&l, 0), s, to(l.a)) == 0);
        for (i = 0; i < l.c.n; i++)
            for (k = 0; k < dim; k++) CHECK_NEAR("a lattice stays", i, l.a[k][i], 0.0, BY_PRECISION(1e-13, 1e-5) * (double)l.c.h);
        liquid_free(&l);
        l = liquid_of(cloud_lattice(dim, sides[dim], 1.3, 0.2, 12), 1);
        lambda = l.out;
        for (i = 0; i < l.c.n; i++) l.c.V[i] = SPH_R(pow(l.c.dx, dim));
        CHECK(sph_free_surface(KERNEL, dim, view(&l, 0), (sph_surface_out){.eigenvalue = lambda, .normal = to(l.u)}) == 0);
        CHECK(sph_shift_displacement(KERNEL, dim, view(&l, 0), s, to(l.a)) == 0);
        s.eigenvalue = sph_scalars_array(lambda);
        s.normal = three(l.u);
        CHECK(sph_shift_displacement(KERNEL, dim, view(&l, 0), s, to(l.b)) == 0);
        for (i = 0; i < l.c.n; i++) {
            double out = 0.0, left = 0.0, moved = 0.0;
            for (k = 0; k < dim; k++) {
                out += (double)l.u[k][i] * (double)l.a[k][i];
                left += (double)l.u[k][i] * (double)l.b[k][i];
                moved += fabs((double)l.b[k][i]);
            }
            if (cloud_walls(&l.c, i)) {
                outward++;
                CHECK_AT("outward at a surface", i, out > 0.0);
            }
            if ((double)lambda[i] < 0.4) CHECK_AT("splash stays", i, moved == 0.0);
            else if ((double)lambda[i] < 0.75) {
                along++;
                CHECK_NEAR("the part along the normal", i, left, 0.0, 8.0 * EPSILON * (double)l.c.h);
            } else
                for (k = 0; k < dim; k++) CHECK_NEAR("inside", i, l.b[k][i], l.a[k][i], 0.0);
        }
        CHECK(outward > 1 && along > 1);
        liquid_free(&l);
    }
}

/* rates of what particles carry, and the transport velocity */
static void test_shift_rates(void)
{
    int dim, own, constant, k;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++)
            for (constant = 0; constant < 2; constant++) {
                liquid l = liquid_periodic(dim, sides[dim], 1.3, 0.25, 13);
                double worst = 0.0, size = 0.0, flux = 0.0, all = 0.0;
                sph_index i, p;
                if (constant)
                    for (i = 0; i < l.c.n; i++) {
                        l.rho[i] = SPH_R(1.25);
                        for (k = 0; k < dim; k++) l.v[k][i] = SPH_R(k + 1);
                    }
                CHECK(sph_shift_rates(KERNEL, dim, view(&l, own), fluid(&l, 1), three(l.u), (sph_fluid_out){.acceleration = to(l.a), .rate = l.out, .status = l.status}) == 0);
                for (i = 0; i < l.c.n; i++) {
                    double x[3], rate = 0.0, a[3] = {0, 0, 0}, part = 0.0;
                    for (p = l.c.start[i]; p < l.c.start[i + 1]; p++) {
                        const sph_index j = l.c.index[p];
                        const double r = apart(&l, i, j, x), F = pair_f(&l, r, pair_h(&l, own, i, j)), V = (double)l.c.V[j],
                                     ri = (double)l.rho[i], rj = (double)l.rho[j];
                        double ui = 0.0, uj = 0.0;
                        for (k = 0; k < dim; k++) {
                            ui += (double)l.u[k][i] * x[k] * F * V;
                            uj += (double)l.u[k][j] * x[k] * F * V;
                        }
                        if (constant) { /* the residue, in closed form */
                            rate += 2.0 * ri * ui;
                            for (k = 0; k < dim; k++) a[k] += 2.0 * (double)l.v[k][i] * ui;
                        } else {
                            rate += ri * (ui - uj) + ri * ui + rj * uj;
                            for (k = 0; k < dim; k++) a[k] += (double)l.v[k][i] * (ui - uj) + (double)l.v[k][i] * ui + (double)l.v[k][j] * uj;
                        }
                        part += ri * (ui - uj);
                    }
                    worst = fmax(worst, fabs(rate - (double)l.out[i]));
                    size = fmax(size, fabs(rate));
                    for (k = 0; k < dim; k++) worst = fmax(worst, fabs(a[k] - (double)l.a[k][i]));
                    flux += (double)l.c.V[i] * ((double)l.out[i] - part);
                    all += (double)l.c.V[i] * fabs((double)l.out[i]);
                }
                CHECK(size > 0.1);
                CHECK_WORST(check_words("rates of shifting in %dD", dim), worst, BY_PRECISION(1e-12, 1e-4) * size);
                CHECK_WORST(check_words("sum of V div(rho u) in %dD", dim), flux, BY_PRECISION(1e-13, 1e-4) * all);
                liquid_free(&l);
            }
}
/* f += dx . grad f keeps a linear field, which the particles then have at their new places */
static void test_shift_linear(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        liquid l = liquid_of(cloud_lattice(dim, sides[dim], 1.4, 0.25, 5), 6);
        const sph_real strength = SPH_R(0.4) * l.c.h * l.c.h;
        const sph_derivatives_out g = {.gx = l.g[0], .gy = l.g[1], .gz = l.g[2]};
        sph_shift s = {0};
        sph_index i;
        s.strength = sph_scalars_same(&strength);
        cloud_set(&l.c, field_linear);
        CHECK(sph_gradient_cspm(KERNEL, dim, view(&l, 0), cloud_f(&l.c), g) == 0);
        CHECK(sph_shift_displacement(KERNEL, dim, view(&l, 0), s, to(l.a)) == 0);
        for (i = 0; i < l.c.n; i++) {
            double f = (double)l.c.f[i], x[3];
            int k;
            cloud_position(&l.c, i, x);
            for (k = 0; k < dim; k++) {
                f += (double)l.g[k][i] * (double)l.a[k][i];
                x[k] += (double)l.a[k][i];
            }
            CHECK_NEAR("a linear field after a shift", i, f, field_linear(x, 0), BY_PRECISION(1e-12, 1e-5));
        }
        liquid_free(&l);
    }
}
static void test_transport(void)
{
    int dim, own, k;
    for (dim = 1; dim <= 3; dim++)
        for (own = 0; own < 2; own++) {
            liquid l = liquid_periodic(dim, sides[dim], 1.3, 0.25, 14);
            const sph_real pressure = SPH_R(2.5);
            const sph_transport_out out = {to(l.a), to(l.b), l.status};
            sph_fluid f = fluid(&l, 1);
            double worst = 0.0, size = 0.0, sum[6] = {0, 0, 0, 0, 0, 0}, all = 0.0, same = 0.0;
            sph_index i, p;
            CHECK(sph_transport_adami(KERNEL, dim, view(&l, own), f, three(l.u), pressure, out) == 0);
            f.p = sph_scalars_same(&pressure);
            f.viscosity = SPH_VISCOSITY_NONE;
            CHECK(sph_fluid_rates_hu_adams(KERNEL, dim, view(&l, own), f, (sph_fluid_out){.acceleration = to(l.g)}) == 0);
            for (i = 0; i < l.c.n; i++) {
                double x[3], a[3] = {0, 0, 0};
                const double Vi = (double)l.m[i] / (double)l.rho[i];
                for (p = l.c.start[i]; p < l.c.start[i + 1]; p++) {
                    const sph_index j = l.c.index[p];
                    const double r = apart(&l, i, j, x), F = pair_f(&l, r, pair_h(&l, own, i, j)), Vj = (double)l.m[j] / (double)l.rho[j];
                    double di = 0.0, dj = 0.0;
                    for (k = 0; k < dim; k++) {
                        di += ((double)l.u[k][i] - (double)l.v[k][i]) * x[k] * F;
                        dj += ((double)l.u[k][j] - (double)l.v[k][j]) * x[k] * F;
                    }
                    for (k = 0; k < dim; k++)
                        a[k] += (Vi * Vi + Vj * Vj) / (double)l.m[i] * 0.5 * ((double)l.rho[i] * (double)l.v[k][i] * di + (double)l.rho[j] * (double)l.v[k][j] * dj);
                }
                for (k = 0; k < dim; k++) {
                    worst = fmax(worst, fabs(a[k] - (double)l.b[k][i]));
                    same = fmax(same, fabs((double)l.g[k][i] - (double)l.a[k][i]));
                    size = fmax(size, fabs(a[k]));
                    sum[k] += (double)l.m[i] * (double)l.a[k][i];
                    sum[3 + k] += (double)l.m[i] * (double)l.b[k][i];
                    all += (double)l.m[i] * (fabs((double)l.a[k][i]) + fabs((double)l.b[k][i]));
                }
            }
            CHECK(size > 0.1);
            CHECK_WORST(check_words("stress of the drift in %dD", dim), worst, BY_PRECISION(1e-12, 1e-4) * size);
            CHECK_WORST(check_words("background pressure beside the sweep of Hu & Adams in %dD", dim), same, BY_PRECISION(1e-12, 1e-4) * size);
            for (k = 0; k < 6; k++) CHECK_WORST(check_words("momentum of the transport velocity in %dD", dim), sum[k], 20.0 * EPSILON * all);
            for (k = 0; k < 3; k++) memcpy(l.u[k], l.v[k], (size_t)l.c.n * sizeof(sph_real)); /* no drift, no stress */
            CHECK(sph_transport_adami(KERNEL, dim, view(&l, own), fluid(&l, 1), three(l.u), pressure, out) == 0);
            for (i = 0; i < l.c.n; i++)
                for (k = 0; k < dim; k++) CHECK_AT("stress without drift", i, (double)l.b[k][i] == 0.0);
            liquid_free(&l);
        }
}
static void test_shift_strengths(void)
{
    CHECK_RELATIVE((double)sph_shift_strength_skillen(SPH_R(3), SPH_R(0.1), SPH_R(0.02)), 0.006, 8.0 * EPSILON);
    /* half of dt v (2 h)^2 / h */
    CHECK_RELATIVE((double)sph_shift_strength_sun(SPH_R(0.1), SPH_R(0.02), SPH_R(0.1)), 0.5 * 0.01 * 2.0 * 0.04 / 0.1, 8.0 * EPSILON);
}

/* ---- particles that are packed: the residue |h sum V grad W|, rms, before and after 40 steps ---- */

static double residue(liquid *l, int dim, sph_real strength, int first, int last)
{
    sph_shift s = {0};
    double sum = 0.0;
    sph_index i;
    int k;
    s.strength = sph_scalars_same(&strength);
    s.longest = SPH_R(-1);
    CHECK(sph_shift_displacement(KERNEL, dim, view(l, 0), s, to(l->a)) == 0);
    for (i = first; i < last; i++)
        for (k = 0; k < dim; k++) sum += pow((double)l->a[k][i] * (double)l->c.h / (double)strength, 2.0);
    return sqrt(sum / (last - first));
}
static double relaxed(int dim, double h_over_dx, double factor, uint64_t seed)
{
    static const int side[] = {0, 40, 20, 10};
    liquid l = liquid_periodic(dim, side[dim], h_over_dx, 0.2, seed);
    const sph_real strength = SPH_R(factor) * l.c.h * l.c.h;
    double before = 0.0, after = 0.0;
    int step;
    for (step = 0; step <= 40; step++) {
        sph_index i;
        lists(&l, 2.0 * (double)l.c.h);
        after = residue(&l, dim, strength, 0, (int)l.c.n);
        if (!step) before = after;
        for (i = 0; i < l.c.n; i++) {
            l.c.x[i] += l.a[0][i];
            if (dim > 1) l.c.y[i] += l.a[1][i];
            if (dim > 2) l.c.z[i] += l.a[2][i];
        }
    }
    liquid_free(&l);
    return after / before;
}
/* a disc among particles on a lattice that do not move */
static double relaxed_disc(uint64_t seed)
{
    enum { SIDE = 36 };
    const double h = 1.65, dx = 1.0, radius = 12.0;
    cloud c = cloud_new(2, SIDE * SIDE);
    liquid l;
    sph_index inside = 0, outside = SIDE * SIDE, i;
    double before = 0.0, after = 0.0;
    sph_real strength;
    pcg32 g;
    int step, at;
    pcg32_seed(&g, seed, 3);
    for (at = 0; at < SIDE * SIDE; at++) {
        const double x = at % SIDE - 0.5 * (SIDE - 1), y = at / SIDE - 0.5 * (SIDE - 1);
        const int in = x * x + y * y < radius * radius;
        i = in ? inside++ : --outside;
        c.x[i] = SPH_R(x * dx + (in ? 0.4 * cloud_symmetric(&g) : 0.0));
        c.y[i] = SPH_R(y * dx + (in ? 0.4 * cloud_symmetric(&g) : 0.0));
        c.V[i] = SPH_R(1);
    }
    c.h = SPH_R(h);
    l = liquid_of(c, seed);
    strength = SPH_R(0.4) * l.c.h * l.c.h;
    for (step = 0; step <= 40; step++) {
        lists(&l, 2.0 * h);
        after = residue(&l, 2, strength, 0, (int)inside);
        if (!step) before = after;
        for (i = 0; i < inside; i++) {
            l.c.x[i] += l.a[0][i];
            l.c.y[i] += l.a[1][i];
        }
    }
    for (i = 0; i < inside; i++) CHECK_AT("inside its disc", i, pow((double)l.c.x[i], 2.0) + pow((double)l.c.y[i], 2.0) < pow(radius + 0.8, 2.0));
    liquid_free(&l);
    return after / before;
}
/* Over seeds 1 to 3 the residue falls to 0.9 to 1.6 % in 2D, 0.3 to 0.6 % in 1D and 2.2 to 2.3 % in 3D; the disc's to 1.2 to 1.5 %. */
static void test_packing(void)
{
    static const double ratios[] = {1.3, 1.65, 2.0};
    int dim, k;
    uint64_t seed;
    for (seed = 1; seed <= 3; seed++) {
        for (k = 0; k < 3; k++) CHECK(relaxed(2, ratios[k], 0.4, seed) < 0.02);
        CHECK(relaxed(1, 1.65, 0.4, seed) < 0.02);
        CHECK(relaxed_disc(seed) < 0.02);
    }
    CHECK(relaxed(3, 1.65, 0.4, 1) < 0.03);
    for (dim = 1; dim <= 3; dim++) CHECK(relaxed(dim, 1.65, 1.2, 1) > 2.0); /* too long a shift diverges */
}

/* ---- surfaces that are known by construction ---- */

enum { SQUARE, DISC, RING, HOLE, CUBE, TORUS, SHAPES };
static const char *const shape_names[] = {"square", "disc", "annulus", "hole", "cube", "ball with a torus inside"};
/* truth: 1 surface, 0 not; 2: neither is asked for */
static liquid shape(int which, double h_over_dx, double jitter, uint64_t seed, unsigned char **truth)
{
    const int dim = which >= CUBE ? 3 : 2;
    cloud c = cloud_new(dim, 12000);
    liquid l;
    unsigned char *const t = (unsigned char *)cloud_memory((size_t)c.n, 1);
    pcg32 g;
    sph_index n = 0, i;
    int a, b, e;
    if (which == SQUARE)
        for (a = 0; a < 40; a++)
            for (b = 0; b < 40; b++) {
                c.x[n] = SPH_R(a);
                c.y[n] = SPH_R(b);
                t[n++] = a == 0 || b == 0 || a == 39 || b == 39;
            }
    if (which == DISC || which == RING)
        for (a = which == DISC ? 0 : 10; a <= 20; a++) {
            const int around = a ? (int)(2.0 * PI * a + 0.5) : 1;
            for (b = 0; b < around; b++) {
                c.x[n] = SPH_R(a * cos(2.0 * PI * b / around));
                c.y[n] = SPH_R(a * sin(2.0 * PI * b / around));
                t[n++] = a == 20 || (which == RING && a == 10);
            }
        }
    if (which == HOLE)
        for (a = 0; a < 14; a++)
            for (b = 0; b < 14; b++) {
                const double x = a - 6.5, y = b - 6.5, r = sqrt(x * x + y * y);
                if (r < 1.6) continue;
                c.x[n] = SPH_R(a);
                c.y[n] = SPH_R(b);
                t[n++] = a == 0 || b == 0 || a == 13 || b == 13 || r < 2.6;
            }
    if (which == CUBE)
        for (a = 0; a < 20; a++)
            for (b = 0; b < 20; b++)
                for (e = 0; e < 20; e++) {
                    c.x[n] = SPH_R(a);
                    c.y[n] = SPH_R(b);
                    c.z[n] = SPH_R(e);
                    t[n++] = a == 0 || b == 0 || e == 0 || a == 19 || b == 19 || e == 19;
                }
    if (which == TORUS) /* a ball of radius 13 less a torus of radii 7 and 3 */
        for (a = -13; a <= 13; a++)
            for (b = -13; b <= 13; b++)
                for (e = -13; e <= 13; e++) {
                    const double r = sqrt((double)(a * a + b * b)), out = 13.0 - sqrt(r * r + e * e), in = sqrt((r - 7.0) * (r - 7.0) + e * e) - 3.0, deep = fmin(out, in);
                    if (deep < 0.0) continue;
                    c.x[n] = SPH_R(a);
                    c.y[n] = SPH_R(b);
                    c.z[n] = SPH_R(e);
                    t[n++] = deep < 0.5 ? 1 : deep > 1.8 ? 0 : 2;
                }
    c.n = n;
    c.dx = 1.0;
    c.h = SPH_R(h_over_dx);
    pcg32_seed(&g, seed, 9);
    for (i = 0; i < n; i++) {
        c.x[i] += SPH_R(jitter * cloud_symmetric(&g));
        c.y[i] += SPH_R(jitter * cloud_symmetric(&g));
        if (dim > 2) c.z[i] += SPH_R(jitter * cloud_symmetric(&g));
        c.V[i] = SPH_R(1);
    }
    l = liquid_of(c, seed);
    lists(&l, 2.0 * h_over_dx);
    *truth = t;
    return l;
}
enum { BY_DIVERGENCE, BY_LAMBDA, BY_CONE, BY_SUM, DETECTORS };
typedef struct found {
    double right[DETECTORS], wrong[DETECTORS]; /* in per cent */
    double angle, most;                        /* of the normals of the surface that was found, in degrees: mean and largest */
} found;
static found detect(int which, double h_over_dx, double jitter, uint64_t seed)
{
    unsigned char *truth;
    liquid l = shape(which, h_over_dx, jitter, seed, &truth);
    const int dim = l.c.dim;
    sph_real *const lambda = l.rho, *const divergence = l.m;
    unsigned char *const flag = (unsigned char *)cloud_memory((size_t)l.c.n, 1);
    const sph_surface_out out = {.divergence = divergence, .eigenvalue = lambda, .normal = to(l.u), .status = l.status};
    long count[2] = {0, 0}, hits[DETECTORS][2] = {{0, 0}}, flagged = 0, normals = 0;
    found f;
    sph_index i, said;
    int d;
    memset(&f, 0, sizeof f);
    CHECK(sph_free_surface(KERNEL, dim, view(&l, 0), out) == 0);
    said = sph_free_surface_cone(dim, view(&l, 0), sph_scalars_array(lambda), three(l.u), flag);
    CHECK(sph_shepard_sum(KERNEL, dim, view(&l, 0), sph_scalar_out_array(l.out, 0)) == 0);
    for (i = 0; i < l.c.n; i++) {
        const int is[DETECTORS] = {(double)divergence[i] < (dim == 2 ? 1.5 : 2.4), (double)lambda[i] < 0.75, flag[i], (double)l.out[i] < 0.8};
        flagged += flag[i];
        if (truth[i] == 2) continue;
        count[truth[i]]++;
        for (d = 0; d < DETECTORS; d++) hits[d][truth[i]] += is[d];
        if (which == DISC && truth[i] && flag[i]) {
            const double x = (double)l.c.x[i], y = (double)l.c.y[i];
            const double angle = 180.0 / PI * acos(fmin(1.0, (x * (double)l.u[0][i] + y * (double)l.u[1][i]) / sqrt(x * x + y * y)));
            f.angle += angle;
            f.most = fmax(f.most, angle);
            normals++;
        }
    }
    CHECK(said == flagged);
    for (d = 0; d < DETECTORS; d++) {
        f.right[d] = 100.0 * (double)hits[d][1] / (double)count[1];
        f.wrong[d] = 100.0 * (double)hits[d][0] / (double)count[0];
    }
    if (normals) f.angle /= (double)normals;
    liquid_free(&l);
    free(truth);
    free(flag);
    return f;
}
/* Particles found and others found, in per cent. Over seeds 1 to 3 at a jitter of 0.3 the cone finds 99.2 to 100 % of the surface and 0 to 0.17 % of
   others. How far the normals of a disc's rim are off in the mean: 7.7 to 9.3 degrees for h = 1.33, 5.0 to 6.2 for 1.6, 3.0 to 3.7 for 2. */
static void test_surfaces(void)
{
    static const double ratios[] = {1.33, 1.6, 2.0}, jitters[] = {0.0, 0.15, 0.3}, mean_angles[] = {10.0, 6.5, 4.0}, most_angles[] = {40.0, 25.0, 14.0};
    int which, a, b;
    uint64_t seed;
    for (which = SQUARE; which <= CUBE; which++)
        for (a = 0; a < 3; a++)
            for (b = 0; b < 3; b++)
                for (seed = 1; seed <= (b && which <= RING ? 3 : 1); seed++) {
                    const char *said;
                    found f;
                    if (which == CUBE && (a == 1 || b == 1)) continue;
                    f = detect(which, ratios[a], jitters[b], seed);
                    said = check_words("%s, h %.2f, jitter %.2f, seed %d", shape_names[which], ratios[a], jitters[b], (int)seed);
                    if (which == HOLE) { /* 1.5 spacings wide: not every row of its rim is found for a long h */
                        if (a < 2) CHECK_WORST(said, 100.0 - f.right[BY_CONE], 10.0);
                        continue;
                    }
                    CHECK_WORST(said, 100.0 - f.right[BY_CONE], b ? 1.0 : 0.0);
                    CHECK_WORST(said, f.wrong[BY_CONE], b ? 0.2 : 0.0);
                    CHECK_WORST(said, 100.0 - f.right[BY_LAMBDA], 0.2);
                    CHECK_WORST(said, 100.0 - f.right[BY_DIVERGENCE], b ? 5.0 : 0.0);
                    CHECK_WORST(said, f.wrong[BY_DIVERGENCE], a == 2 ? 8.0 : 1.5);
                    if (a == 0 && b == 2) {                      /* the two that are not to be taken for the surface */
                        CHECK(f.wrong[BY_LAMBDA] > 3.0);         /* it marks a band */
                        CHECK(f.right[BY_SUM] < 70.0);
                    }
                    if (which == DISC) {
                        CHECK_WORST(said, f.angle, b == 2 ? mean_angles[a] : b ? 0.6 * mean_angles[a] : 0.1);
                        CHECK_WORST(said, f.most, b == 2 ? most_angles[a] : b ? 0.6 * most_angles[a] : 0.1);
                    }
                }
    for (b = 0; b < 2; b++) {
        const found f = detect(TORUS, 1.33, b ? 0.3 : 0.0, 1);
        CHECK_WORST("a ball with a torus inside", 100.0 - f.right[BY_CONE], b ? 3.0 : 0.0);
        CHECK_WORST("a ball with a torus inside", f.wrong[BY_CONE], b ? 0.2 : 0.0);
    }
}
/* no particle of a periodic box is at a surface; one alone is; a pair in 2D has no normal; a target among two lines is seen from one side */
static void test_surface_limits(void)
{
    int dim, jittered;
    for (dim = 1; dim <= 3; dim++)
        for (jittered = 0; jittered < 2; jittered++) {
            static const int even[] = {0, 40, 16, 10};
            liquid l = liquid_periodic(dim, even[dim], 1.6, jittered ? 0.1 : 0.0, 21);
            sph_index i;
            CHECK(sph_free_surface(KERNEL, dim, view(&l, 0), (sph_surface_out){.divergence = l.m, .eigenvalue = l.rho, .normal = to(l.u)}) == 0);
            CHECK(sph_free_surface_cone(dim, view(&l, 0), sph_scalars_array(l.rho), three(l.u), l.status) == 0);
            for (i = 0; i < l.c.n; i++) {
                CHECK_NEAR("div r inside", i, l.m[i], dim, jittered ? 0.4 : 0.05);
                CHECK_AT("lambda inside", i, (double)l.rho[i] > 0.8);
                if (!jittered && !SPH_SINGLE) CHECK_AT("no normal inside a lattice", i, fabs((double)l.u[0][i]) + fabs((double)l.u[1][i]) + fabs((double)l.u[2][i]) == 0.0);
            }
            liquid_free(&l);
        }
    {
        liquid l = liquid_of(cloud_new(2, 3), 1); /* two near each other, and one alone */
        l.c.x[1] = SPH_R(0.5);
        l.c.x[2] = SPH_R(10);
        for (dim = 0; dim < 3; dim++) l.c.V[dim] = SPH_R(0.3);
        lists(&l, 2.0);
        CHECK(sph_free_surface(KERNEL, 2, view(&l, 0), (sph_surface_out){.divergence = l.m, .eigenvalue = l.rho, .normal = to(l.u), .status = l.status}) == 3);
        CHECK(l.status[0] == SPH_TOO_FEW && l.status[2] == SPH_TOO_FEW);
        CHECK((double)l.m[0] > 0.0 && (double)l.rho[0] == 0.0 && (double)l.m[2] == 0.0);
        CHECK(sph_free_surface_cone(2, view(&l, 0), sph_scalars_array(l.rho), three(l.u), l.status) == 3);
        CHECK(l.status[0] == 1 && l.status[1] == 1 && l.status[2] == 1);
        liquid_free(&l);
    }
}
/* The cone in 2D as it is printed: beyond sqrt(2) h a disc about T = x + h n, within it a square about T. */
static void test_cone(void)
{
    pcg32 g;
    int i, inside = 0;
    pcg32_seed(&g, 3, 3);
    for (i = 0; i < 20000; i++) {
        const double turn = PI * cloud_symmetric(&g), x = 2.5 * cloud_symmetric(&g), y = 2.5 * cloud_symmetric(&g), h = 1.1;
        const double n[2] = {cos(turn), sin(turn)}, tx = x - h * n[0], ty = y - h * n[1], r = sqrt(x * x + y * y);
        const double disc = sqrt(tx * tx + ty * ty), square = fabs(n[0] * tx + n[1] * ty) + fabs(n[0] * ty - n[1] * tx);
        const int expected = r < sqrt(2.0) * h ? square < h : disc < h;
        const sph_vec normal = {SPH_R(n[0]), SPH_R(n[1]), SPH_R(0)}, x_ij = {SPH_R(-x), SPH_R(-y), SPH_R(0)};
        if (fabs(r - sqrt(2.0) * h) < 1e-3 || fabs(square - h) < 1e-3 || fabs(disc - h) < 1e-3) continue; /* at an edge rounding decides */
        CHECK(sph_surface_covers(2, normal, x_ij, SPH_R(h)) == expected);
        inside += expected;
    }
    CHECK(inside > 2000);
}

/* alpha of DFSPH: with kappa_i = alpha_i drho_i/dt / dt for one particle, and 0 for all others, the change of the velocities takes drho_i/dt away to rounding, whatever the masses, whichever neighbours stand still.
   The velocities change by sph_gradient_symmetric (f = kappa rho), the rate is that of sph_divergence_difference: same h for all, because both have grad W with the h of their own. */
static double density_rate(const liquid *l, sph_medium medium, sph_index i)
{
    CHECK(sph_divergence_difference(KERNEL, l->c.dim, sph_cloud_range(view(l, 0), i, i + 1), medium, three(l->v), sph_scalar_out_array(l->out, 0)) == 0);
    return -(double)(l->rho[i] * l->out[i]);
}
/* the largest density rate after passes that correct all particles at once, by a part of what each alone would need */
static double pressure_passes(liquid *l, sph_medium medium, const sph_real *alpha, double part, int passes)
{
    sph_real *const kappa = l->b[1];
    double worst = 0.0;
    sph_index i;
    int k;
    while (passes-- > 0) {
        for (i = 0; i < l->c.n; i++) kappa[i] = SPH_R(part * density_rate(l, medium, i)) * alpha[i] * l->rho[i];
        CHECK(sph_gradient_symmetric(KERNEL, l->c.dim, view(l, 0), medium, sph_scalars_array(kappa), to(l->a)) == 0);
        for (i = 0; i < l->c.n; i++)
            for (k = 0; k < l->c.dim; k++) l->v[k][i] -= l->a[k][i] / l->rho[i];
    }
    for (i = 0; i < l->c.n; i++) worst = fmax(worst, fabs(density_rate(l, medium, i)));
    return worst;
}
static void test_pressure_factor(void)
{
    static const sph_real one = SPH_R(1);
    static const double eigenvalue[] = {0.0, 2.4, 3.4, 5.9};
    int dim, k;
    for (dim = 1; dim <= 3; dim++) {
        liquid l = dim == 2 ? liquid_of(cloud_lattice(2, 14, 1.4, 0.3, 9), 9) : liquid_periodic(dim, dim == 1 ? 40 : 7, 1.4, 0.3, 9);
        const sph_index n = l.c.n;
        const sph_medium medium = {sph_scalars_array(l.m), sph_scalars_array(l.rho), sph_scalars_same(&one)};
        sph_real *const alpha = l.b[0], *const kappa = l.b[1];
        double before = 0.0, after = 0.0, largest;
        sph_index i, j;
        int walls;
        for (walls = 0; walls < 2; walls++) {
            const sph_scalars moves = walls ? sph_scalars_array(l.share) : sph_scalars_none();
            for (i = 0; i < n; i++) {
                l.m[i] *= SPH_R(1.0 + 0.5 * (double)l.v[0][i]); /* unequal */
                if (walls && l.share[i] == SPH_R(0)) l.m[i] *= SPH_R(2);
            }
            CHECK(sph_pressure_factor_dfsph(KERNEL, dim, view(&l, 0), fluid(&l, 0), moves, sph_scalar_out_array(alpha, l.status)) == 0);
            for (i = 0; i < n; i += 1 + n / 9) {
                const double rate = density_rate(&l, medium, i);
                if (walls && l.share[i] == SPH_R(0)) continue;
                CHECK(alpha[i] > SPH_R(0) && l.status[i] == SPH_OK);
                for (j = 0; j < n; j++) kappa[j] = SPH_R(0);
                kappa[i] = alpha[i] * SPH_R(rate) * l.rho[i]; /* dt = 1 */
                CHECK(sph_gradient_symmetric(KERNEL, dim, view(&l, 0), medium, sph_scalars_array(kappa), to(l.a)) == 0);
                for (j = 0; j < n; j++)
                    for (k = 0; k < dim; k++)
                        if (!walls || l.share[j] != SPH_R(0)) l.v[k][j] -= l.a[k][j] / l.rho[j];
                before = fmax(before, fabs(rate));
                after = fmax(after, fabs(density_rate(&l, medium, i)));
            }
        }
        CHECK(before > 0.5);
        CHECK_WORST("density rate after the correction of one particle", after / before, 100.0 * EPSILON);
        /* All at once it is Jacobi's iteration. With all of the correction it diverges here, as the largest eigenvalue says, with 1.5 times the inverse of that it converges. */
        for (i = 0; i < n; i++) {
            l.rho[i] = SPH_R(1);
            l.m[i] = l.c.V[i];
        }
        CHECK(sph_pressure_factor_dfsph(KERNEL, dim, view(&l, 0), fluid(&l, 0), sph_scalars_none(), sph_scalar_out_array(alpha, 0)) == 0);
        for (k = 0; k < dim; k++) memcpy(l.u[k], l.v[k], (size_t)n * sizeof(sph_real));
        before = pressure_passes(&l, medium, alpha, 1.0, 20); /* the mode that grows is alone then */
        largest = 1.0 + pow(pressure_passes(&l, medium, alpha, 1.0, 20) / before, 0.05);
        CHECK_CLOSE(largest, eigenvalue[dim], 0.05 * eigenvalue[dim]);
        for (k = 0; k < dim; k++) memcpy(l.v[k], l.u[k], (size_t)n * sizeof(sph_real));
        before = pressure_passes(&l, medium, alpha, 0.0, 0);
        CHECK(pressure_passes(&l, medium, alpha, 1.5 / largest, 50) < 0.1 * before);
#ifdef SAY
        printf("%dD: density rate of one after its correction %.3g; largest eigenvalue %.3g; of all %.3g\n", dim, after, largest, pressure_passes(&l, medium, alpha, 0.0, 0) / before);
#endif
        liquid_free(&l);
    }
    { /* particles that nothing pushes: alone, coincident */
        liquid l = liquid_of(cloud_new(2, 3), 1);
        const sph_index start[] = {0, 1, 2, 2}, index[] = {1, 0};
        memset(l.c.x, 0, 3 * sizeof *l.c.x);
        memset(l.c.y, 0, 3 * sizeof *l.c.y);
        l.c.x[2] = SPH_R(5);
        l.c.h = SPH_R(1);
        for (k = 0; k < 3; k++) l.m[k] = l.rho[k] = SPH_R(1);
        for (k = 0; k < 4; k++) l.c.start[k] = start[k];
        free(l.c.index);
        l.c.index = (sph_index *)cloud_memory(2, sizeof *l.c.index);
        for (k = 0; k < 2; k++) l.c.index[k] = index[k];
        CHECK(sph_pressure_factor_dfsph(KERNEL, 2, view(&l, 0), fluid(&l, 0), sph_scalars_none(), sph_scalar_out_array(l.out, l.status)) == 3);
        for (k = 0; k < 3; k++) CHECK(l.status[k] == SPH_TOO_FEW && l.out[k] == SPH_R(0));
        liquid_free(&l);
    }
}

int main(void)
{
    test_diffusion_by_hand();
    test_diffusion_linear();
    test_diffusion_step();
    test_shift_by_hand();
    test_shift_at_a_surface();
    test_shift_rates();
    test_shift_linear();
    test_transport();
    test_shift_strengths();
    test_packing();
    test_surfaces();
    test_surface_limits();
    test_cone();
    test_pressure_factor();
    return check_report("test_liquid");
}
