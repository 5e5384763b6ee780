/* SPDX-License-Identifier: MIT */
/*
 * test_collisions.c - collisions of particles: what a pair keeps and loses, that the sequential and the weighted form never gain energy, and that the form as printed does.
 */
#include "one_copy.h"

#include "../examples/papers/collision_literal.h"
#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

#define EPSILON ((double)SPH_EPSILON)

static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }

typedef struct gas {
    cloud c;
    sph_real *w, *v[3], *dv[3];
    sph_index *count;
    sph_real distance;
} gas;

static gas gas_of(cloud c, double distance)
{
    gas g;
    int k;
    g.c = c;
    g.distance = SPH_R(distance);
    g.w = (sph_real *)cloud_memory(7 * (size_t)c.n, sizeof *g.w);
    g.count = (sph_index *)cloud_memory((size_t)c.n, sizeof *g.count);
    for (k = 0; k < 3; k++) {
        g.v[k] = g.w + (k + 1) * c.n;
        g.dv[k] = g.w + (k + 4) * c.n;
    }
    cloud_neighbors(&g.c, distance);
    return g;
}
static void gas_free(gas *g)
{
    cloud_free(&g->c);
    free(g->w);
    free(g->count);
}
static sph_vectors gas_v(const gas *g) { return sph_vectors_separate(g->v[0], g->v[1], g->v[2]); }
static sph_cloud gas_cloud(const gas *g)
{
    return sph_cloud_of(cloud_points(&g->c), cloud_list(&g->c), sph_scalars_none(), sph_scalars_none());
}
static sph_collision gas_collision(const gas *g, double restitution)
{
    const sph_collision c = {g->distance, SPH_R(restitution), sph_scalars_array(g->w)};
    return c;
}

enum { SEQUENTIAL, WEIGHTED, LITERAL, FORMS };
/* one sweep over all particles; the velocities are changed */
static sph_index collide(int form, gas *g, double restitution, sph_collision_report *report)
{
    const int dim = g->c.dim;
    const sph_cloud all = gas_cloud(g);
    const sph_collision c = gas_collision(g, restitution);
    const sph_vectors v = gas_v(g);
    const sph_vector_out dv = sph_vector_out_separate(g->dv[0], g->dv[1], g->dv[2]);
    sph_index i, answer;
    int k;
    if (form == SEQUENTIAL)
        return sph_collision_sequential(dim, all, c, sph_vector_out_separate(g->v[0], g->v[1], g->v[2]),
                                      report);
    if (form == WEIGHTED) {
        answer = sph_collision_count(dim, all, c, v, g->count);
        CHECK(answer >= 0);
        answer = sph_collision_change_weighted(dim, all, c, v, g->count, dv);
    } else {
        answer = 0;
        collision_change_literal(dim, all, c, v, dv);
    }
    for (i = 0; i < g->c.n; i++)
        for (k = 0; k < dim; k++) g->v[k][i] += g->dv[k][i];
    return answer;
}
/* sums with m = 1/w; walls left out */
static void sums(const gas *g, double momentum[3], double *angular, double *energy, double *size)
{
    sph_index i;
    int k;
    momentum[0] = momentum[1] = momentum[2] = *angular = *energy = *size = 0.0;
    for (i = 0; i < g->c.n; i++) {
        double x[3], m;
        if (g->w[i] == SPH_R(0)) continue;
        m = 1.0 / (double)g->w[i];
        cloud_position(&g->c, i, x);
        for (k = 0; k < g->c.dim; k++) {
            momentum[k] += m * (double)g->v[k][i];
            *energy += 0.5 * m * (double)g->v[k][i] * (double)g->v[k][i];
            *size += m * fabs((double)g->v[k][i]);
        }
        *angular += m * (x[0] * (double)g->v[1][i] - x[1] * (double)g->v[0][i]);
    }
}

static void test_pair(void)
{
    pcg32 r;
    int trial;
    pcg32_seed(&r, 3, 3);
    for (trial = 0; trial < 500; trial++) {
        const int dim = 1 + trial % 3;
        const double restitution = trial % 5 == 0 ? 1.0 : trial % 5 == 1 ? 0.0 : pcg32_uniform(&r);
        cloud c = cloud_new(dim, 2);
        gas g;
        sph_collision_report report = {0, 0, SPH_R(0)};
        double p[2][3], l[2], e[2], size, vn = 0.0, after = 0.0, r2 = 0.0, mu, m[2];
        int k, form;
        for (k = 0; k < 3; k++) {
            sph_real *const a = k == 0 ? c.x : k == 1 ? c.y : c.z;
            a[0] = SPH_R(k < dim ? 0.3 + 0.2 * pcg32_uniform(&r) : 0.0);
            a[1] = SPH_R(k < dim ? 0.3 + 0.2 * pcg32_uniform(&r) : 0.0);
        }
        g = gas_of(c, 0.5);
        for (form = 0; form < 2; form++) {
            pcg32 again = r;
            for (k = 0; k < 3; k++) g.v[k][0] = SPH_R(k < dim ? cloud_symmetric(&again) : 0.0), g.v[k][1] = SPH_R(k < dim ? cloud_symmetric(&again) : 0.0);
            for (k = 0; k < 2; k++) {
                m[k] = pow(10.0, 2.0 * cloud_symmetric(&again));
                g.w[k] = SPH_R(1.0 / m[k]);
            }
            for (k = 0, vn = r2 = 0.0; k < dim; k++) {
                const double d = k == 0 ? (double)(c.x[0] - c.x[1]) : k == 1 ? (double)(c.y[0] - c.y[1]) : (double)(c.z[0] - c.z[1]);
                vn += d * (double)(g.v[k][0] - g.v[k][1]);
                r2 += d * d;
            }
            vn /= sqrt(r2);
            mu = 1.0 / (double)(g.w[0] + g.w[1]);
            sums(&g, p[0], &l[0], &e[0], &size);
            CHECK(collide(form, &g, restitution, &report) == 0);
            sums(&g, p[1], &l[1], &e[1], &size);
            for (k = 0, after = 0.0; k < dim; k++) {
                const double d = k == 0 ? (double)(c.x[0] - c.x[1]) : k == 1 ? (double)(c.y[0] - c.y[1]) : (double)(c.z[0] - c.z[1]);
                after += d * (double)(g.v[k][0] - g.v[k][1]) / sqrt(r2);
                CHECK_CLOSE(p[1][k], p[0][k], 16.0 * EPSILON * size);
            }
            if (dim > 1) CHECK_CLOSE(l[1], l[0], 16.0 * EPSILON * size);
            CHECK_CLOSE(after, vn < 0.0 ? -restitution * vn : vn, 64.0 * EPSILON * (1.0 + 2.0 / sqrt(r2)));
            CHECK_CLOSE(e[1] - e[0], vn < 0.0 ? -0.5 * mu * (1.0 - restitution * restitution) * vn * vn : 0.0, 64.0 * EPSILON * (e[0] + size));
            if (form == SEQUENTIAL) {
                CHECK(report.collisions == (vn < 0.0) && report.coincident == 0);
                CHECK_CLOSE((double)report.energy, e[1] - e[0], 64.0 * EPSILON * (e[0] + size));
            }
        }
        (void)pcg32_uniform(&r);
        gas_free(&g);
    }
}

/* a patch at 0.8 of its proper spacing, with random velocities */
static gas patch(uint64_t seed, int walls)
{
    enum { SIDE = 9 };
    const double d = 0.8;
    cloud c = cloud_new(2, SIDE * SIDE);
    gas g;
    pcg32 r;
    sph_index i;
    for (i = 0; i < c.n; i++) {
        c.x[i] = SPH_R(d * (i % SIDE + 0.5 * (i / SIDE % 2)));
        c.y[i] = SPH_R(d * sqrt(0.75) * (i / SIDE));
    }
    g = gas_of(c, 0.85);
    pcg32_seed(&r, seed, 8);
    for (i = 0; i < c.n; i++) {
        g.w[i] = SPH_R(walls && i < SIDE ? 0.0 : 1.0 / (1.0 + 0.9 * cloud_symmetric(&r)));
        g.v[0][i] = SPH_R(walls && i < SIDE ? 0.0 : cloud_symmetric(&r));
        g.v[1][i] = SPH_R(walls && i < SIDE ? 0.0 : cloud_symmetric(&r));
    }
    return g;
}

static void test_energy(void)
{
    static const double restitution[] = {0.01, 0.5, 1.0};
    int k, form, seed, sweep, grew = 0;
    for (k = 0; k < 3; k++)
        for (form = 0; form < FORMS; form++)
            for (seed = 0; seed < 10; seed++) {
                gas g = patch((uint64_t)seed, 0);
                double p[2][3], l[2], e[2], size, start, first_size;
                sums(&g, p[0], &l[0], &start, &size);
                first_size = size;
                e[0] = start;
                for (sweep = 0; sweep < 20; sweep++) {
                    sph_collision_report report = {0, 0, SPH_R(0)};
                    CHECK(collide(form, &g, restitution[k], &report) == 0);
                    sums(&g, p[1], &l[1], &e[1], &size);
                    if (form != LITERAL) {
                        CHECK(e[1] <= e[0] * (1.0 + 64.0 * EPSILON));
                        CHECK_CLOSE(p[1][0], p[0][0], 200.0 * EPSILON * first_size);
                        CHECK_CLOSE(p[1][1], p[0][1], 200.0 * EPSILON * first_size);
                        CHECK_CLOSE(l[1], l[0], 200.0 * EPSILON * 8.0 * first_size);
                        if (form == SEQUENTIAL) CHECK_CLOSE((double)report.energy, e[1] - e[0], 200.0 * EPSILON * start);
                    }
                    e[0] = e[1];
                }
                if (form == SEQUENTIAL && restitution[k] == 1.0) CHECK_CLOSE(e[1], start, 500.0 * EPSILON * start);
                if (form != LITERAL && restitution[k] < 1.0) CHECK(e[1] < 0.9 * start);
                if (form == LITERAL) grew += e[1] > 1e3 * start;
                gas_free(&g);
            }
    CHECK(grew == 30); /* (4.20) as printed, at every restitution */
}

/* walls have no mass to lose: the whole impulse goes to the particle, and the wall keeps its velocity; two walls do not collide */
static void test_walls(void)
{
    int form;
    for (form = 0; form < 2; form++) {
        gas g = patch(3, 1);
        sph_index i;
        double p[3], l, e[2], size;
        sums(&g, p, &l, &e[0], &size);
        CHECK(collide(form, &g, 0.3, 0) == 0);
        sums(&g, p, &l, &e[1], &size);
        for (i = 0; i < 9; i++) CHECK(g.v[0][i] == SPH_R(0) && g.v[1][i] == SPH_R(0));
        CHECK(e[1] < e[0]);
        gas_free(&g);
    }
    {
        cloud c = cloud_new(2, 2);
        gas g;
        c.x[1] = SPH_R(0.5);
        g = gas_of(c, 1.0);
        g.w[1] = SPH_R(2); /* a particle that flies at a wall that comes to meet it */
        g.v[0][0] = SPH_R(1);
        g.v[0][1] = SPH_R(-2);
        CHECK(collide(SEQUENTIAL, &g, 0.5, 0) == 0);
        CHECK_CLOSE((double)g.v[0][1], 1.0 + 0.5 * 3.0, 8.0 * EPSILON);
        CHECK((double)g.v[0][0] == 1.0);
        gas_free(&g);
    }
}

/* sources that are no targets: halo particles and walls without rows. Half lists do as well as full ones. Another order of a pair's rows gives the same for weighted collisions. */
static void test_lists(void)
{
    gas full = patch(5, 0), half = patch(5, 0), part = patch(5, 0);
    sph_index i, p, q = 0;
    double worst = 0.0;
    for (i = 0; i < half.c.n; i++) { /* j > i only */
        const sph_index begin = half.c.start[i], end = half.c.start[i + 1];
        half.c.start[i] = q;
        for (p = begin; p < end; p++)
            if (half.c.index[p] > i) half.c.index[q++] = half.c.index[p];
    }
    half.c.start[half.c.n] = q;
    /* rows of ascending neighbours, so that the order of collisions is the same */
    for (i = 0; i < full.c.n; i++)
        for (p = full.c.start[i] + 1; p < full.c.start[i + 1]; p++) {
            sph_index j = full.c.index[p], r = p;
            for (; r > full.c.start[i] && full.c.index[r - 1] > j; r--) full.c.index[r] = full.c.index[r - 1];
            full.c.index[r] = j;
        }
    for (i = 0; i < half.c.n; i++)
        for (p = half.c.start[i] + 1; p < half.c.start[i + 1]; p++) {
            sph_index j = half.c.index[p], r = p;
            for (; r > half.c.start[i] && half.c.index[r - 1] > j; r--) half.c.index[r] = half.c.index[r - 1];
            half.c.index[r] = j;
        }
    CHECK(collide(SEQUENTIAL, &full, 0.2, 0) == 0);
    CHECK(collide(SEQUENTIAL, &half, 0.2, 0) == 0);
    for (i = 0; i < full.c.n; i++) worst = worse(worst, (double)(full.v[0][i] - half.v[0][i]));
    CHECK(worst == 0.0);
    /* targets 0 ... 39 only: pairs with the rest count, pairs among the rest do not */
    {
        sph_collision_report report = {0, 0, SPH_R(0)};
        sph_index expected = 0, j;
        gas before = patch(5, 0);
        CHECK(sph_collision_sequential(2, sph_cloud_range(gas_cloud(&part), 0, 40), gas_collision(&part, 1.0),
                                     sph_vector_out_separate(part.v[0], part.v[1], 0), &report) == 0);
        for (i = 40; i < part.c.n; i++) {
            int touched = 0;
            for (p = part.c.start[i]; p < part.c.start[i + 1]; p++) touched |= part.c.index[p] < 40;
            if (!touched) CHECK(part.v[0][i] == before.v[0][i]);
        }
        for (i = 0; i < 40; i++)
            for (p = part.c.start[i]; p < part.c.start[i + 1]; p++) {
                j = part.c.index[p];
                expected += j > i || j >= 40;
            }
        CHECK(report.collisions > 0 && report.collisions <= expected);
        gas_free(&before);
    }
    gas_free(&full);
    gas_free(&half);
    gas_free(&part);
}

static void test_coincident(void)
{
    gas g = patch(6, 0);
    sph_collision_report report = {0, 0, SPH_R(0)};
    sph_index i;
    g.c.x[1] = g.c.x[0];
    g.c.y[1] = g.c.y[0];
    cloud_neighbors(&g.c, 0.85);
    CHECK(sph_collision_count(2, gas_cloud(&g), gas_collision(&g, 0.5), gas_v(&g), g.count) == 2);
    CHECK(collide(WEIGHTED, &g, 0.5, 0) == 0);
    CHECK(collide(SEQUENTIAL, &g, 0.5, &report) == 0);
    CHECK(report.coincident == 1);
    for (i = 0; i < g.c.n; i++) CHECK(sphi_finite(g.v[0][i]) && sphi_finite(g.v[1][i]));
    gas_free(&g);
}

/* a velocity that would leave the range of numbers, of either particle and along either axis: the pair stays as it is */
static void test_overflow(void)
{
    const double large = BY_PRECISION(1.79e308, 3.4e38);
    int dim, axis, heavy, k;
    for (dim = 1; dim <= 3; dim++)
        for (axis = 0; axis < dim; axis++)
            for (heavy = 0; heavy < 2; heavy++) {
                cloud c = cloud_new(dim, 2);
                sph_real *const x[3] = {c.x, c.y, c.z};
                sph_collision_report report = {0, 0, SPH_R(0)};
                gas g;
                x[axis][0] = SPH_R(1);
                g = gas_of(c, 2.0);
                g.w[heavy] = SPH_R(0);
                g.w[1 - heavy] = SPH_R(1);
                g.v[axis][0] = SPH_R((heavy ? 0.1 : -0.59) * large);
                g.v[axis][1] = SPH_R((heavy ? 0.59 : -0.1) * large);
                CHECK(collide(SEQUENTIAL, &g, 1.0, &report) == 1);
                CHECK(report.collisions == 0);
                for (k = 0; k < dim; k++) {
                    CHECK(g.v[k][0] == (k == axis ? SPH_R((heavy ? 0.1 : -0.59) * large) : SPH_R(0)));
                    CHECK(g.v[k][1] == (k == axis ? SPH_R((heavy ? 0.59 : -0.1) * large) : SPH_R(0)));
                }
                gas_free(&g);
            }
}

/* (4.22) is (4.20) over the time step if N = |v_ij| dt / r: for one pair at a time */
static void test_acceleration(void)
{
    cloud c = cloud_new(2, 2);
    gas g;
    sph_vector_out a;
    const double dt = 0.01;
    double speed, r;
    c.x[1] = SPH_R(0.4);
    c.y[1] = SPH_R(0.3);
    g = gas_of(c, 1.0);
    g.w[0] = SPH_R(1);
    g.w[1] = SPH_R(3);
    g.v[0][0] = SPH_R(1);
    g.v[1][1] = SPH_R(-0.5);
    a = sph_vector_out_separate(g.dv[0], g.dv[1], g.dv[2]);
    r = 0.5;
    speed = hypot(1.0, 0.5);
    collision_acceleration_literal(2, gas_cloud(&g), gas_collision(&g, 0.3), gas_v(&g), SPH_R(speed * dt / r), a);
    {
        const double ax = (double)g.dv[0][0];
        collision_change_literal(2, gas_cloud(&g), gas_collision(&g, 0.3), gas_v(&g), a);
        CHECK(ax != 0.0);
        CHECK_RELATIVE((double)g.dv[0][0] / dt, ax, 1e3 * EPSILON);
    }
    gas_free(&g);
}

int main(void)
{
    test_pair();
    test_energy();
    test_walls();
    test_lists();
    test_coincident();
    test_overflow();
    test_acceleration();
    return check_report("test_collisions");
}
