/* SPDX-License-Identifier: MIT */
/*
 * test_collapse [DIR] - the host code of the collapse of a cloud core (examples/papers/collapse*.h): the tree against all pairs and against the grid, equation of state, sink, column density, energy of a
 * pulsating polytrope, restarts bit for bit, and what happens in trouble. In double only. Writes and removes a file in DIR (default: $BUILD, or the current directory).
 */
#include "check.h"

#include "../sph.h"

#if SPH_SINGLE
int main(void) { return check_report("test_collapse"); }
#else

#include "../examples/common/random.h"
#include "../examples/papers/collapse.h"
#include "../examples/papers/collapse_column.h"

static const double PI = 3.14159265358979323846;
static double symmetric(pcg32 *g) { return 2 * pcg32_uniform(g) - 1; }

/* ---- the tree ---- */

typedef struct heap {
    sph_index n;
    double *x[3], *m, *h, *radius, *a[3], *b[3];
    tree t;
    tree_rows rows;
} heap;
/* condensed towards the middle like r^-2, h like what that has, masses 1 +- 0.5; box 0: open */
static heap heap_new(sph_index n, double box)
{
    heap s;
    pcg32 g;
    double *const block = (double *)need(NULL, 12 * (size_t)n, sizeof *block), *spare = (double *)need(NULL, (size_t)n, sizeof *spare);
    sph_index i;
    int c;
    memset(&s, 0, sizeof s);
    s.n = n;
    for (c = 0; c < 3; c++) {
        s.x[c] = block + c * n;
        s.a[c] = block + (3 + c) * n;
        s.b[c] = block + (6 + c) * n;
    }
    s.m = block + 9 * n;
    s.h = block + 10 * n;
    s.radius = block + 11 * n;
    pcg32_seed(&g, 7, 1);
    for (i = 0; i < n; i++) {
        double p[3], r2, r = pcg32_uniform(&g);
        do {
            for (c = 0, r2 = 0; c < 3; c++) {
                p[c] = symmetric(&g);
                r2 += p[c] * p[c];
            }
        } while (r2 > 1 || r2 < 1e-4);
        if (box > 0) r = 3 * r + 0.1; /* reaches across the edges */
        for (c = 0; c < 3; c++) {
            s.x[c][i] = (c == 2 ? 0.6 : 1) * r * p[c] / sqrt(r2);
            if (box > 0) s.x[c][i] -= box * floor(s.x[c][i] / box + 0.5);
        }
        s.m[i] = (1 + 0.5 * symmetric(&g)) / n;
        s.h[i] = 0.01 + 0.1 * pow(r, 2.0 / 3);
    }
    tree_order(&s.t, n, s.x[0], s.x[1], s.x[2]);
    for (c = 0; c < 5; c++) {
        double *const p = c < 3 ? s.x[c] : c == 3 ? s.m : s.h;
        CHECK(sph_permute(n, s.t.order, p, 1, spare) == 0);
        memcpy(p, spare, (size_t)n * sizeof *p);
    }
    free(spare);
    for (i = 0; i < n; i++) s.radius[i] = sph_kernel_support_ratio(COLLAPSE_KERNEL) * s.h[i];
    tree_reach(&s.t, s.radius);
    tree_neighbours(&s.t, s.x[0], s.x[1], s.x[2], s.radius, box, &s.rows);
    return s;
}
static void heap_free(heap *s)
{
    free(s->x[0]);
    tree_free(&s->t);
    tree_rows_free(&s->rows);
}
static sph_list heap_list(const heap *s)
{
    sph_list l;
    l.start = s->rows.start;
    l.index = s->rows.index;
    return l;
}
static sph_cloud heap_cloud(const heap *s)
{
    const sph_points x = sph_points_separate(s->n, s->x[0], s->x[1], s->x[2]);
    return sph_cloud_of(x, heap_list(s), sph_scalars_array(s->h), sph_scalars_none());
}

static int ascending(const void *a, const void *b) { return *(const sph_index *)a < *(const sph_index *)b ? -1 : 1; }
static void test_neighbours(void)
{
    int k;
    for (k = 0; k < 3; k++) {
        const double box = k ? 3.3 : 0;
        const sph_index n = k == 2 ? 5 : 1500; /* fewer than a leaf holds */
        heap s = heap_new(n, box);
        const sph_points x = sph_points_periodic(sph_points_separate(s.n, s.x[0], s.x[1], s.x[2]), box, box, box);
        const sph_scalars radius = sph_scalars_array(s.radius);
        const size_t size = sph_grid_workspace(3, s.n);
        void *const work = need(NULL, size, 1);
        sph_index *const start = (sph_index *)need(NULL, (size_t)s.n + 1, sizeof *start);
        sph_index *const index = (sph_index *)need(NULL, (size_t)s.rows.pairs + 1, sizeof *index);
        sph_grid grid;
        int64_t pairs = 0;
        double widest = 0;
        sph_index i;
        for (i = 0; i < s.n; i++) widest = fmax(widest, s.radius[i]);
        CHECK(sph_grid_build(3, x, radius, work, size, &grid) == 0);
        CHECK(sph_grid_lists(3, &grid, sph_query_of(x, SPH_LARGER, radius, SPH_LIST_SORTED), start, index, s.rows.pairs, &pairs) == 0);
        CHECK(pairs == s.rows.pairs);
        for (i = 0; i < s.n; i++) qsort(s.rows.index + s.rows.start[i], (size_t)(s.rows.start[i + 1] - s.rows.start[i]), sizeof *s.rows.index, ascending);
        CHECK(pairs == s.rows.pairs && memcmp(start, s.rows.start, ((size_t)s.n + 1) * sizeof *start) == 0 &&
              memcmp(index, s.rows.index, (size_t)pairs * sizeof *index) == 0);
        free(work);
        free(start);
        free(index);
        heap_free(&s);
    }
}

/* rms error of the force over the rms force; momentum made over sum m |a| */
static void tree_against_pairs(heap *s, double theta, double *error, double *momentum)
{
    double p[3] = {0, 0, 0}, size = 0, off = 0, all = 0;
    sph_index i;
    int c;
    tree_gravity(COLLAPSE_KERNEL, &s->t, 0, s->t.leaves, theta, s->x[0], s->x[1], s->x[2], s->m, s->h, 0.8, heap_list(s), s->b[0], s->b[1], s->b[2]);
    for (i = 0; i < s->n; i++) {
        double a2 = 0;
        for (c = 0; c < 3; c++) {
            off += pow(s->b[c][i] - s->a[c][i], 2);
            a2 += pow(s->a[c][i], 2);
            p[c] += s->m[i] * s->b[c][i];
        }
        all += a2;
        size += s->m[i] * sqrt(a2);
    }
    *error = sqrt(off / all);
    *momentum = collapse_length(p) / size;
}
static void test_tree_gravity(void)
{
    static const double theta[] = {1, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2};
    enum { ANGLES = sizeof theta / sizeof *theta };
    heap s = heap_new(4000, 0);
    const sph_vector_out a = sph_vector_out_separate(s.a[0], s.a[1], s.a[2]);
    double error[ANGLES], momentum[ANGLES], e, p, whole[3];
    int k, c;
    CHECK(sph_gravity_direct(COLLAPSE_KERNEL, heap_cloud(&s), sph_scalars_array(s.m), 0.8, a, sph_scalar_out_array(NULL, 0)) == 0);
    tree_moments(&s.t, s.x[0], s.x[1], s.x[2], s.m);
    CHECK_CLOSE(s.t.node[0].q[0] + s.t.node[0].q[2] + s.t.node[0].q[5], 0.0, 1e-14);
    for (k = 0; k < ANGLES; k++) {
        tree_against_pairs(&s, theta[k], &error[k], &momentum[k]);
        printf("test_collapse: theta = %.1f, 4000 particles: rms error of the force %.1e, momentum made / sum m |a| %.1e\n", theta[k], error[k], momentum[k]);
        if (k > 0) CHECK(error[k] < error[k - 1]);
    }
    /* the first moment left out is the octopole: theta^3 of the monopole, from where the angle opens nodes and no longer the softening */
    CHECK(error[6] / error[4] < 1.0 / 8);
    CHECK(error[4] < 3e-4 && momentum[4] < 1e-4);
    tree_against_pairs(&s, 1e-9, &e, &p); /* no node is ever far enough: all pairs */
    CHECK_CLOSE(e, 0.0, 1e-13);
    CHECK_CLOSE(p, 0.0, 1e-13);
    /* leaf by leaf the same, to the bit */
    tree_against_pairs(&s, 0.5, &e, &p);
    for (c = 0; c < 3; c++) whole[c] = s.b[c][s.n / 3];
    for (k = 0; k < s.t.leaves; k++)
        tree_gravity(COLLAPSE_KERNEL, &s.t, k, k + 1, 0.5, s.x[0], s.x[1], s.x[2], s.m, s.h, 0.8, heap_list(&s), s.b[0], s.b[1], s.b[2]);
    for (c = 0; c < 3; c++) CHECK(whole[c] == s.b[c][s.n / 3]);
    heap_free(&s);
}
static void test_newton(void)
{
    double h;
    for (h = 0.1; h < 0.9; h += 0.1) {
        CHECK_RELATIVE(sph_gravity_pair(COLLAPSE_KERNEL, 2 * fmax(h, 0.4) * 1.0001, h, 0.4), pow(2 * fmax(h, 0.4) * 1.0001, -3), 1e-14);
        CHECK(sph_gravity_pair(COLLAPSE_KERNEL, 2 * fmax(h, 0.4) * 0.8, h, 0.4) < pow(2 * fmax(h, 0.4) * 0.8, -3));
    }
}

/* ---- equation of state, column density ---- */

static collapse_model plain_model(void)
{
    collapse_model m;
    memset(&m, 0, sizeof m);
    m.m = 1e-3;
    m.cs = 0.19;
    m.medium_cs = 1.04;
    m.rho1 = 5;
    m.rho2 = 5e4;
    m.courant = 0.3;
    m.fastest = 1e6;
    m.theta = 0.5;
    m.alpha_B = 0.1;
    m.alpha_min = 0.1;
    m.alpha_max = 1;
    m.sigma = 1;
    m.tensile = 1;
    m.radius = 0.1;
    m.cleans = m.zeta = 1;
    return m;
}
static void test_equation_of_state(void)
{
    const collapse_model m = plain_model();
    double rho, c, unused;
    for (rho = 1e-3; rho < 1e7; rho *= 1.7) {
        const double slope = (collapse_pressure(&m, 0, rho * 1.00001, &unused) - collapse_pressure(&m, 0, rho * 0.99999, &unused)) / (rho * 2e-5);
        const double pressure = collapse_pressure(&m, 0, rho, &c), gamma = rho < 5 ? 1 : rho < 5e4 ? 1.4 : 1.1;
        CHECK_RELATIVE(c * c, slope, 1e-6);
        CHECK_RELATIVE(c * c, gamma * pressure / rho, 1e-13);
        CHECK_RELATIVE(collapse_pressure(&m, 1, rho, &c), 1.04 * 1.04 * rho, 1e-14);
        CHECK_RELATIVE(c, 1.04, 1e-14);
    }
    for (rho = 5; rho < 6e4; rho *= 1e4)
        CHECK_RELATIVE(collapse_pressure(&m, 0, rho * (1 + 1e-12), &c), collapse_pressure(&m, 0, rho * (1 - 1e-12), &c), 1e-11);
    CHECK_RELATIVE(collapse_pressure(&m, 0, 5e4, &c), 0.19 * 0.19 * 5e4 * pow(1e4, 0.4), 1e-13);
}
static void test_column(void)
{
    static const sph_kernel kernels[] = {SPH_CUBIC_SPLINE, SPH_WENDLAND_C2, SPH_QUINTIC_SPLINE};
    enum { SIDE = 200 };
    double *const pixel = (double *)need(NULL, SIDE * SIDE, sizeof *pixel);
    const double x[2] = {0.1, -0.2}, y[2] = {0.05, 0.3}, h[2] = {0.2, 0.001}, weight[2] = {0.5, 2};
    column_table t;
    int k, i;
    for (k = 0; k < 3; k++) {
        double sum = 0, q;
        t = column_table_of(kernels[k]);
        for (q = 0.0005; q < t.support; q += 0.001) sum += 2 * PI * q * column_shape(&t, q) * 0.001;
        CHECK_RELATIVE(sum, 1.0, 1e-4);
        CHECK(column_shape(&t, t.support) == 0 && column_shape(&t, 1e6) == 0);
    }
    t = column_table_of(SPH_CUBIC_SPLINE);
    CHECK_RELATIVE(column_shape(&t, 0), 1.5 / PI, 1e-8); /* twice the integral of w from 0 to 2 is 3/2 */
    for (i = 0; i < SIDE * SIDE; i++) pixel[i] = 0;
    column_add(&t, 2, x, y, h, 0.7, NULL, 1, SIDE, pixel); /* a wide kernel, and one narrower than a pixel */
    {
        double mass = 0;
        for (i = 0; i < SIDE * SIDE; i++) mass += pixel[i] * pow(2.0 / SIDE, 2);
        CHECK_RELATIVE(mass, 1.4, 1e-2);
        column_add(&t, 2, x, y, h, -0.7, weight, 1, SIDE, pixel);
        for (i = 0, mass = 0; i < SIDE * SIDE; i++) mass += pixel[i] * pow(2.0 / SIDE, 2);
        CHECK_RELATIVE(mass, -0.35, 1e-2); /* 0.7 (1 - 0.5) + 0.7 (1 - 2) */
    }
    free(pixel);
}

/* ---- the sink ---- */

static void test_sink(void)
{
    pcg32 g;
    double m[20], x[20][3], v[20][3], a[20][3], before[13] = {0}, after[13] = {0}, turn[3];
    sink s;
    int i, c, k;
    memset(&s, 0, sizeof s);
    pcg32_seed(&g, 3, 1);
    for (i = 0; i < 20; i++) {
        m[i] = 0.1 + pcg32_uniform(&g);
        for (c = 0; c < 3; c++) {
            x[i][c] = symmetric(&g) + 3;
            v[i][c] = symmetric(&g);
            a[i][c] = symmetric(&g);
        }
        before[0] += m[i];
        sink_cross(x[i], v[i], turn);
        for (c = 0; c < 3; c++) {
            before[1 + c] += m[i] * x[i][c];
            before[4 + c] += m[i] * v[i][c];
            before[7 + c] += m[i] * a[i][c];
            before[10 + c] += m[i] * turn[c];
        }
        sink_absorb(&s, m[i], x[i], v[i], a[i]);
    }
    after[0] = s.m;
    sink_cross(s.x, s.v, turn);
    for (c = 0; c < 3; c++) {
        after[1 + c] = s.m * s.x[c];
        after[4 + c] = s.m * s.v[c];
        after[7 + c] = s.m * s.a[c];
        after[10 + c] = s.m * turn[c] + s.spin[c];
    }
    for (k = 0; k < 13; k++) CHECK_CLOSE(after[k], before[k], 1e-13);
    CHECK(s.swallowed == 20 && collapse_length(s.spin) > 0.1);

    memset(&s, 0, sizeof s);
    s.m = 1;
    s.radius = 0.1;
    {
        const double rest[3] = {0, 0, 0}, within[3] = {0.05, 0.06, 0}, edge[3] = {0.095, 0, 0}, out[3] = {0.101, 0, 0};
        const double circle[3] = {0, sqrt(1 / 0.095), 0}, fast[3] = {5, 0, 0}, turning[3] = {0, sqrt(1.2 / 0.095), 0}, slow[3] = {0, 0.9 * sqrt(1 / 0.095), 0};
        CHECK(sink_takes(&s, 1, within, fast) && sink_takes(&s, 1, edge, rest) && sink_takes(&s, 1, edge, slow));
        CHECK(!sink_takes(&s, 1, out, rest));
        CHECK(!sink_takes(&s, 1, edge, fast));    /* not bound */
        CHECK(!sink_takes(&s, 1, edge, turning)); /* bound, and turns too fast */
        CHECK(sink_takes(&s, 1, edge, circle));   /* a circular orbit inside the radius has less than one at the radius */
        s.m = 0;
        CHECK(!sink_takes(&s, 1, rest, rest));
    }
    {
        const sink_clump good = {0.05, -1, 0.4, 0.3, 0.1, 0.2, 1};
        sink_clump c0 = good;
        CHECK(sink_objection(&good, 0.1) == NULL);
        CHECK(sink_objection(&good, 0.04) != NULL);
        c0.div_v = 0.1;
        CHECK(sink_objection(&c0, 0.1) != NULL);
        c0 = good;
        c0.thermal = 0.51;
        CHECK(sink_objection(&c0, 0.1) != NULL);
        c0 = good;
        c0.rotation = 0.61;
        CHECK(sink_objection(&c0, 0.1) != NULL);
        c0 = good;
        c0.magnetic = 0.31;
        CHECK(sink_objection(&c0, 0.1) != NULL);
    }
}

/* ---- gas ---- */

/* A ball of n particles in a glass of sorts, radius 1, or what of it is inside the box */
static void ball(collapse *g, const collapse_model *model, sph_index n)
{
    pcg32 random;
    sph_index i;
    int c;
    collapse_new(g, model, n);
    pcg32_seed(&random, 11, 1);
    for (i = 0; i < n; i++) {
        double best = -1, p[3], at[3] = {0, 0, 0}, r2;
        int tries;
        for (tries = 0; tries < 12; tries++) { /* of twelve places that which is farthest from everybody */
            double nearest = 1e9;
            sph_index j;
            do {
                for (c = 0, r2 = 0; c < 3; c++) {
                    p[c] = symmetric(&random);
                    r2 += p[c] * p[c];
                }
            } while (r2 > 1);
            for (j = 0; j < i; j++) nearest = fmin(nearest, pow(p[0] - g->a[X][j], 2) + pow(p[1] - g->a[Y][j], 2) + pow(p[2] - g->a[Z][j], 2));
            if (nearest > best) {
                best = nearest;
                memcpy(at, p, sizeof at);
            }
        }
        for (c = 0; c < 3; c++) g->a[X + c][i] = at[c];
        g->a[VX][i] = -0.3 * at[1];
        g->a[VY][i] = 0.3 * at[0];
        g->a[BZ][i] = 0.1;
        g->a[ALPHA][i] = model->alpha_min;
        g->a[H][i] = COLLAPSE_ETA * cbrt(4 * PI / 3 / n);
        g->a[ID][i] = i;
    }
    CHECK(collapse_rates(g) == 0);
}

/* kinetic, thermal (P / (0.4 rho) at gamma = 1.4) and that of gravity */
static double energy(const collapse *g)
{
    double *const phi = (double *)need(NULL, 4 * (size_t)g->s.n, sizeof *phi), e = 0;
    const sph_vector_out a = sph_vector_out_separate(phi + g->s.n, phi + 2 * g->s.n, phi + 3 * g->s.n);
    const sph_cloud open =
        sph_cloud_of(collapse_open(g), collapse_list(g), collapse_field(g, H), sph_scalars_none());
    sph_index i;
    CHECK(sph_gravity_direct(COLLAPSE_KERNEL, open, sph_scalars_same(&g->model.m), 1, a, sph_scalar_out_array(phi, 0)) == 0);
    for (i = 0; i < g->s.n; i++)
        e += g->model.m * (0.5 * (pow(g->a[VX][i], 2) + pow(g->a[VY][i], 2) + pow(g->a[VZ][i], 2)) + g->a[P][i] / (0.4 * g->a[RHO][i]) + 0.5 * phi[i]);
    free(phi);
    return e;
}
/* Largest change of the energy of a polytrope that relaxes by pulsations, without viscosity, over its potential energy (about 0.6) */
static double polytrope(double theta, int zeta, double courant)
{
    collapse_model m = plain_model();
    collapse g;
    double e0, worst = 0;
    sph_index shortest;
    m.m = 1.0 / 300;
    m.theta = theta;
    m.zeta = zeta;
    m.rho1 = 1e-12;
    m.rho2 = 1e12;
    m.cs = 0.75 * pow(m.rho1, 0.2); /* P = 0.56 rho^1.4: about in equilibrium at 1.2 times the radius */
    m.alpha_B = m.alpha_min = m.alpha_max = 0;
    m.cleans = 0;
    m.courant = courant;
    ball(&g, &m, 300);
    {
        sph_index i;
        for (i = 0; i < g.s.n; i++) g.a[BZ][i] = 1e-9;
        CHECK(collapse_rates(&g) == 0);
    }
    e0 = energy(&g);
    while (g.s.t < 6) {
        CHECK(collapse_step(&g, collapse_longest_step(&g, &shortest)) == 0);
        worst = fmax(worst, fabs(energy(&g) - e0));
    }
    collapse_free(&g);
    return worst / 0.6;
}
static void test_polytrope(void)
{
    const double with = polytrope(0, 1, 0.15), without = polytrope(0, 0, 0.15), by_tree = polytrope(0.4, 1, 0.15);
    printf("test_collapse: energy of a pulsating polytrope: %.1e with the term of an h that follows the density, %.1e without; %.1e with the tree\n", with,
           without, by_tree);
    CHECK(with < 2e-3);
    CHECK(by_tree < 2e-3);
    CHECK(without > 2 * with);
}

static int same(const collapse *a, const collapse *b)
{
    const size_t size = (size_t)a->s.n * sizeof(double);
    int k;
    if (memcmp(&a->s, &b->s, sizeof a->s) != 0) return 0;
    for (k = 0; k < ARRAYS; k++)
        if (memcmp(a->a[k], b->a[k], size) != 0) return 0;
    for (k = 0; k < EVOLVED; k++)
        if (memcmp(a->rate[k], b->rate[k], size) != 0) return 0;
    return 1;
}
static void steps(collapse *g, int count)
{
    sph_index shortest;
    for (; count > 0; count--) CHECK(collapse_step(g, collapse_longest_step(g, &shortest)) == 0);
}
static void copy_file(const char *from, const char *to, long cut, long flip)
{
    FILE *const a = fopen(from, "rb"), *const b = fopen(to, "wb");
    int c;
    long at;
    CHECK(a && b);
    if (!a || !b) return;
    for (at = 0; (c = getc(a)) != EOF && (cut < 0 || at < cut); at++) putc(at == flip ? c ^ 4 : c, b);
    fclose(a);
    fclose(b);
}
static void test_restart(const char *dir)
{
    collapse_model m = plain_model();
    collapse a, b;
    char note[] = "what the driver keeps", path[PART_FILE_PATH + 64], other[PART_FILE_PATH + 64];
    void *more;
    size_t size;
    int c;
    m.m = 1.0 / 400;
    m.box = 5;
    m.radius = 0.3;
    ball(&a, &m, 400);
    for (c = 0; c < 3; c++) a.s.core.x[c] = 0.1 * c;
    a.s.core.m = 0.2;
    a.s.core.radius = m.radius;
    steps(&a, 5);
    CHECK(a.s.n < 400 && a.s.core.swallowed == 400 - a.s.n); /* the sink has been fed */
    CHECK_RELATIVE(a.s.core.m + a.s.n * m.m, 1.2, 1e-13);
    CHECK(collapse_save(&a, dir, "test_collapse", note, sizeof note) == 1);
    steps(&a, 7);
    collapse_new(&b, &m, 400);
    CHECK(collapse_load(&b, dir, "test_collapse", &more, &size) == 1);
    CHECK(size == sizeof note && memcmp(more, note, size) == 0);
    free(more);
    steps(&b, 7);
    CHECK(same(&a, &b));
    steps(&b, 1);
    CHECK(!same(&a, &b));

    snprintf(path, sizeof path, "%s/test_collapse.restart", dir);
    snprintf(other, sizeof other, "%s/test_collapse_bad.restart", dir);
    copy_file(path, other, 3000, -1);
    CHECK(collapse_load(&b, dir, "test_collapse_bad", &more, &size) == -1 && strstr(b.trouble, "cut short"));
    free(more);
    copy_file(path, other, -1, 20000);
    CHECK(collapse_load(&b, dir, "test_collapse_bad", &more, &size) == -1 && strstr(b.trouble, "damaged"));
    free(more);
    copy_file(path, other, -1, 3);
    CHECK(collapse_load(&b, dir, "test_collapse_bad", &more, &size) == -1 && strstr(b.trouble, "no restart"));
    free(more);
    CHECK(collapse_load(&b, dir, "test_collapse_none", &more, &size) == 0);
    b.model.theta = 0.45;
    CHECK(collapse_load(&b, dir, "test_collapse", &more, &size) == -1 && strstr(b.trouble, "other parameters"));
    free(more);
    CHECK(collapse_save(&a, "no/such/folder", "test_collapse", note, sizeof note) == 0 && strstr(a.trouble, "no/such/folder"));
    remove(path);
    remove(other);
    collapse_free(&a);
    collapse_free(&b);
}

/* Trouble leaves the gas as it was. */
static void test_trouble(void)
{
    collapse_model m = plain_model();
    collapse g;
    collapse_state then;
    double x, v;
    sph_index shortest;
    m.m = 1.0 / 200;
    ball(&g, &m, 200);
    steps(&g, 1);
    then = g.s;
    x = g.a[X][7];
    v = g.a[VY][7];
    g.a[ID][5] = 1234;
    g.a[BY][5] = (double)NAN;
    CHECK(collapse_step(&g, collapse_longest_step(&g, &shortest)) == 1);
    CHECK(g.trouble[0] != '\0');
    CHECK(memcmp(&then, &g.s, sizeof then) == 0 && g.a[X][7] == x && g.a[VY][7] == v);
    g.a[BY][5] = 0;
    g.a[X][5] = (double)INFINITY;
    CHECK(collapse_step(&g, 0.001) == 1 && strstr(g.trouble, "particle 1234"));
    g.a[X][5] = 0.2;
    g.model.fastest = 1e-3;
    CHECK(collapse_step(&g, 0.001) == 1 && strstr(g.trouble, "signal"));
    CHECK(memcmp(&then, &g.s, sizeof then) == 0);
    g.model.fastest = 1e6;
    steps(&g, 1);
    collapse_free(&g);
}

int main(int argc, char **argv)
{
    const char *dir = argc > 1 ? argv[1] : getenv("BUILD");
    test_neighbours();
    test_tree_gravity();
    test_newton();
    test_equation_of_state();
    test_column();
    test_sink();
    test_polytrope();
    test_restart(dir ? dir : ".");
    test_trouble();
    return check_report("test_collapse");
}
#endif
