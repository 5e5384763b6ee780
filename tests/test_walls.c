/* SPDX-License-Identifier: MIT */
/*
 * test_walls.c - walls by boundary integrals: gamma and its gradient beside quadrature of the kernel over the fluid, in 1D, 2D and 3D, for every kernel that is a piecewise
 * polynomial; elements that are divided, touched, listed and periodic; and the operators that use gamma.
 *
 * The quadrature knows the kernel alone: the share of it in the pyramid (triangle, interval) between x and an element is g(r) integrated over the solid angle of the element, where
 * g(r) is the integral of W s^(dim-1) up to r.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <string.h>

#define EPSILON ((double)SPH_EPSILON)

static double worse(double m, double a) { return fabs(a) <= m ? m : fabs(a); }
static double square(double x) { return x * x; }

/* ---- quadrature: Gauss-Legendre of 8 points, exact for degree 15 ---- */

static double gauss(double (*f)(double, const void *), const void *with, double a, double b)
{
    static const double x[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363}, w[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    double sum = 0.0;
    int k;
    for (k = 0; k < 4; k++) sum += w[k] * (f(0.5 * (a + b - (b - a) * x[k]), with) + f(0.5 * (a + b + (b - a) * x[k]), with));
    return 0.5 * (b - a) * sum;
}
static double adaptive(double (*f)(double, const void *), const void *with, double a, double b, double whole, double allowed, int depth)
{
    const double m = 0.5 * (a + b), left = gauss(f, with, a, m), right = gauss(f, with, m, b);
    if (depth == 0 || fabs(left + right - whole) < allowed) return left + right;
    return adaptive(f, with, a, m, left, 0.5 * allowed, depth - 1) + adaptive(f, with, m, b, right, 0.5 * allowed, depth - 1);
}
static double integral(double (*f)(double, const void *), const void *with, double a, double b) { return adaptive(f, with, a, b, gauss(f, with, a, b), BY_PRECISION(1e-13, 1e-6), 30); }

typedef struct ray {
    sph_kernel k;
    int dim;
    double h, e, d; /* distance to the line of an edge, and height above its plane (3D) */
} ray;
static double moment(double s, const void *with)
{
    const ray *const r = (const ray *)with;
    return (double)sph_kernel_w(r->k, r->dim, SPH_R(s), SPH_R(r->h)) * pow(s, r->dim - 1);
}
/* g(r): piece by piece, so that it is exact */
static double share(const ray *with, double r)
{
    static const double breaks[] = {0.0, 0.5, 2.0 / 3.0, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0};
    double sum = 0.0;
    int k;
    for (k = 0; k + 1 < (int)(sizeof breaks / sizeof *breaks) && breaks[k] * with->h < r; k++)
        sum += gauss(moment, with, breaks[k] * with->h, fmin(r, breaks[k + 1] * with->h));
    return sum;
}
/* 2D: by the angle, s along the segment */
static double fan(double s, const void *with)
{
    const ray *const r = (const ray *)with;
    const double rr = s * s + r->e * r->e;
    return share(r, sqrt(rr)) * r->e / rr;
}
/* 3D: by the height, in the plane at the distance r from x, then by the angle of the edge */
static double slant(double r, const void *with) { return share((const ray *)with, r) / (r * r); }
static double sector(double s, const void *with)
{
    const ray *const t = (const ray *)with;
    const double rho2 = s * s + t->e * t->e, r = sqrt(rho2 + t->d * t->d), end = 4.0 * t->h;
    /* beyond the support g is a constant */
    double sum = adaptive(slant, with, t->d, fmin(r, end), gauss(slant, with, t->d, fmin(r, end)), 1e-12, 12);
    if (r > end) sum += share(t, end) * (1.0 / end - 1.0 / r);
    return sum * t->d * t->e / rho2;
}

static sph_vec vec(double x, double y, double z)
{
    sph_vec v;
    v.x = SPH_R(x);
    v.y = SPH_R(y);
    v.z = SPH_R(z);
    return v;
}
static int exists(int k) { return sph_wall_kernel_of((sph_kernel)k, 2).pieces > 0; }

static void test_which(void)
{
    int k, some = 0;
    for (k = 0; k < SPH_KERNEL_COUNT; k++) {
        some += exists(k);
        CHECK(exists(k) == (k != SPH_GAUSSIAN && k != SPH_SUPER_GAUSSIAN && k != SPH_SCHUESSLER_SCHMITT));
    }
    CHECK(some == SPH_KERNEL_COUNT - 3);
}

/* ---- 1D ---- */

static void test_points(void)
{
    int k, p;
    for (k = 0; k < SPH_KERNEL_COUNT; k++) {
        const sph_wall_kernel t = sph_wall_kernel_of((sph_kernel)k, 1);
        if (!exists(k)) continue;
        for (p = 0; p < 12; p++) { /* the fluid between x - left and x + right */
            const double left = 0.07 * p, right = 0.9 - 0.05 * p;
            const ray r = {(sph_kernel)k, 1, 0.3, 0.0, 0.0};
            const sph_wall_part a = sph_wall_point(&t, SPH_R(-left), SPH_R(-1), SPH_R(0.3)), b = sph_wall_point(&t, SPH_R(right), SPH_R(1), SPH_R(0.3));
            CHECK_CLOSE(1.0 + (double)(a.gamma + b.gamma), share(&r, left) + share(&r, right), BY_PRECISION(1e-12, 1e-4));
            CHECK_CLOSE((double)(a.gradient.x + b.gradient.x), (double)(sph_kernel_w((sph_kernel)k, 1, SPH_R(left), SPH_R(0.3)) - sph_kernel_w((sph_kernel)k, 1, SPH_R(right), SPH_R(0.3))),
                        BY_PRECISION(1e-11, 1e-3));
        }
    }
}

/* ---- 2D: a polygon that is not convex, and several x in it ---- */

static const double corner[7][2] = {{0.0, 0.0}, {1.0, -0.1}, {1.2, 0.5}, {0.7, 0.4}, {0.6, 1.0}, {0.3, 0.7}, {-0.2, 0.8}};
static sph_wall_part polygon(const sph_wall_kernel *t, double x, double y, double h, int parts)
{
    sph_wall_part sum, part;
    int c, p;
    sum.gamma = SPH_R(1);
    sum.gradient = vec(0.0, 0.0, 0.0);
    for (c = 0; c < 7; c++)
        for (p = 0; p < parts; p++) {
            const double *const a = corner[c], *const b = corner[(c + 1) % 7];
            const double u = (double)p / parts, v = (double)(p + 1) / parts;
            part = sph_wall_segment(t, vec(a[0] + u * (b[0] - a[0]) - x, a[1] + u * (b[1] - a[1]) - y, 0.0), vec(a[0] + v * (b[0] - a[0]) - x, a[1] + v * (b[1] - a[1]) - y, 0.0), SPH_R(h));
            sum.gamma += part.gamma;
            sum.gradient.x += part.gradient.x;
            sum.gradient.y += part.gradient.y;
        }
    return sum;
}
static double polygon_by_quadrature(int k, double x, double y, double h)
{
    double sum = 0.0;
    int c;
    for (c = 0; c < 7; c++) {
        const double *const a = corner[c], *const b = corner[(c + 1) % 7], size = hypot(b[0] - a[0], b[1] - a[1]), tx = (b[0] - a[0]) / size, ty = (b[1] - a[1]) / size;
        const double d = (a[0] - x) * ty - (a[1] - y) * tx, s = (a[0] - x) * tx + (a[1] - y) * ty;
        const ray r = {(sph_kernel)k, 2, h, fabs(d), 0.0};
        sum += (d < 0.0 ? -1.0 : 1.0) * integral(fan, &r, s, s + size);
    }
    return sum;
}
static void test_segments(void)
{
    static const double at[][2] = {{0.5, 0.3}, {0.05, 0.04}, {0.65, 0.45}, {0.3, 0.66}, {1.1, 0.4}};
    int k, p;
    for (k = 0; k < SPH_KERNEL_COUNT; k++) {
        const sph_wall_kernel t = sph_wall_kernel_of((sph_kernel)k, 2);
        double off = 0.0, divided = 0.0, slope = 0.0;
        if (!exists(k)) continue;
        for (p = 0; p < 5; p++) {
            const double x = at[p][0], y = at[p][1], h = 0.24, step = BY_PRECISION(1e-3, 1e-2);
            const sph_wall_part one = polygon(&t, x, y, h, 1), many = polygon(&t, x, y, h, 7);
            off = worse(off, (double)one.gamma - polygon_by_quadrature(k, x, y, h));
            divided = worse(divided, (double)(one.gamma - many.gamma));
            divided = worse(divided, h * (double)(one.gradient.x - many.gradient.x));
            /* differences of fourth order */
            slope = worse(slope, (double)one.gradient.x - (8.0 * (double)(polygon(&t, x + step, y, h, 1).gamma - polygon(&t, x - step, y, h, 1).gamma) -
                                                           (double)(polygon(&t, x + 2.0 * step, y, h, 1).gamma - polygon(&t, x - 2.0 * step, y, h, 1).gamma)) /
                                                              (12.0 * step));
            slope = worse(slope, (double)one.gradient.y - (8.0 * (double)(polygon(&t, x, y + step, h, 1).gamma - polygon(&t, x, y - step, h, 1).gamma) -
                                                           (double)(polygon(&t, x, y + 2.0 * step, h, 1).gamma - polygon(&t, x, y - 2.0 * step, h, 1).gamma)) /
                                                              (12.0 * step));
        }
        CHECK_WORST(check_words("gamma in 2D, %s", sph_kernel_name((sph_kernel)k)), off, BY_PRECISION(1e-10, 3e-4));
        CHECK_WORST(check_words("gamma in 2D by divided segments, %s", sph_kernel_name((sph_kernel)k)), divided, BY_PRECISION(1e-12, 3e-4));
        CHECK_WORST(check_words("grad gamma in 2D, %s", sph_kernel_name((sph_kernel)k)), slope, BY_PRECISION(2e-5, 2e-1));
    }
}
/* the same by the sum over a fine lattice, which knows nothing of angles */
static void test_lattice(void)
{
    const sph_wall_kernel t = sph_wall_kernel_of(SPH_WENDLAND_C2, 2);
    const double x = 0.9, y = 0.15, h = 0.24, side = 1.0 / 400.0;
    double sum = 0.0;
    int i, j, c;
    for (i = -120; i < 520; i++)
        for (j = -120; j < 520; j++) {
            const double u = (i + 0.5) * side, v = (j + 0.5) * side;
            int inside = 0;
            for (c = 0; c < 7; c++) { /* how often a line to the right crosses the polygon */
                const double *const a = corner[c], *const b = corner[(c + 1) % 7];
                if ((a[1] > v) != (b[1] > v) && u < a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
            }
            if (inside) sum += side * side * (double)sph_kernel_w(SPH_WENDLAND_C2, 2, SPH_R(hypot(u - x, v - y)), SPH_R(h));
        }
    CHECK_CLOSE((double)polygon(&t, x, y, h, 1).gamma, sum, 1e-3); /* what the sum has of an error at the slanted sides */
    CHECK(sum < 0.9);
}

/* ---- 3D: a tetrahedron ---- */

static const double top[4][3] = {{0.0, 0.0, 0.0}, {1.0, 0.1, -0.1}, {0.2, 1.1, 0.1}, {0.1, 0.2, 0.9}};
static const int face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
static void add(sph_wall_part *sum, sph_wall_part part)
{
    sum->gamma += part.gamma;
    sum->gradient.x += part.gradient.x;
    sum->gradient.y += part.gradient.y;
    sum->gradient.z += part.gradient.z;
}
static sph_wall_part tetrahedron(const sph_wall_kernel *t, const double *x, double h, int divided)
{
    sph_wall_part sum;
    int f, i;
    sum.gamma = SPH_R(1);
    sum.gradient = vec(0.0, 0.0, 0.0);
    for (f = 0; f < 4; f++) {
        double v[3][3], m[3];
        for (i = 0; i < 3; i++) {
            int k;
            for (k = 0; k < 3; k++) v[k][i] = top[face[f][k]][i] - x[i];
            m[i] = 0.5 * v[0][i] + 0.3 * v[1][i] + 0.2 * v[2][i];
        }
        if (!divided) add(&sum, sph_wall_triangle(t, vec(v[0][0], v[0][1], v[0][2]), vec(v[1][0], v[1][1], v[1][2]), vec(v[2][0], v[2][1], v[2][2]), SPH_R(h)));
        for (i = 0; i < 3 && divided; i++) {
            const double *const a = v[i], *const b = v[(i + 1) % 3];
            add(&sum, sph_wall_triangle(t, vec(a[0], a[1], a[2]), vec(b[0], b[1], b[2]), vec(m[0], m[1], m[2]), SPH_R(h)));
        }
    }
    return sum;
}
static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}
static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static double tetrahedron_by_quadrature(int k, const double *x, double h)
{
    double sum = 0.0;
    int f, i, c;
    for (f = 0; f < 4; f++) {
        double v[3][3], ab[3], ac[3], n[3], d;
        for (c = 0; c < 3; c++)
            for (i = 0; i < 3; i++) v[c][i] = top[face[f][c]][i] - x[i];
        for (i = 0; i < 3; i++) {
            ab[i] = v[1][i] - v[0][i];
            ac[i] = v[2][i] - v[0][i];
        }
        cross(ab, ac, n);
        d = sqrt(dot(n, n));
        for (i = 0; i < 3; i++) n[i] /= d;
        d = dot(n, v[0]);
        for (c = 0; c < 3; c++) {
            const double *const a = v[c], *const b = v[(c + 1) % 3];
            double t[3], out[3], size = 0.0, e, s;
            ray r = {(sph_kernel)k, 3, h, 0.0, d};
            for (i = 0; i < 3; i++) {
                t[i] = b[i] - a[i];
                size += t[i] * t[i];
            }
            size = sqrt(size);
            for (i = 0; i < 3; i++) t[i] /= size;
            cross(t, n, out);
            e = dot(a, out);
            s = dot(a, t);
            r.e = fabs(e);
            sum += (e < 0.0 ? -1.0 : 1.0) * adaptive(sector, &r, s, s + size, gauss(sector, &r, s, s + size), 1e-11, 10);
        }
    }
    return sum;
}
static void test_triangles(void)
{
    static const double at[][3] = {{0.3, 0.3, 0.2}, {0.05, 0.1, 0.08}};
    int k, p;
    for (k = 0; k < SPH_KERNEL_COUNT; k++) {
        const sph_wall_kernel t = sph_wall_kernel_of((sph_kernel)k, 3);
        const char *const name = sph_kernel_name((sph_kernel)k);
        if (!exists(k)) continue;
        { /* seen from behind, what is taken from gamma is given back */
            const sph_vec a = vec(-0.3, -0.2, 0.1), b = vec(0.4, -0.1, 0.15), d = vec(0.1, 0.5, 0.05);
            const sph_wall_part front = sph_wall_triangle(&t, a, b, d, SPH_R(0.19)), back = sph_wall_triangle(&t, a, d, b, SPH_R(0.19));
            CHECK((double)front.gamma < -0.01 && (double)front.gradient.z < 0.0);
            CHECK_CLOSE((double)(front.gamma + back.gamma), 0.0, 50.0 * EPSILON);
            CHECK_CLOSE((double)(front.gradient.z + back.gradient.z), 0.0, BY_PRECISION(1e-11, 1e-3)); /* as in 1D: the polynomials are in powers of q */
        }
        for (p = 0; p < 2; p++) {
            const double h = 0.19, step = BY_PRECISION(1e-3, 1e-2);
            const sph_wall_part one = tetrahedron(&t, at[p], h, 0), many = tetrahedron(&t, at[p], h, 1);
            int c;
            if (!SPH_SINGLE && p == k % 2) CHECK_WORST(check_words("gamma in 3D, %s", name), (double)one.gamma - tetrahedron_by_quadrature(k, at[p], h), 1e-10);
            CHECK_WORST(check_words("gamma in 3D by divided triangles, %s", name), (double)(one.gamma - many.gamma), BY_PRECISION(1e-12, 1e-3));
            CHECK((double)one.gamma < 0.999);
            for (c = 0; c < 3; c++) {
                double y[3], g[4];
                int q;
                for (q = 0; q < 4; q++) {
                    memcpy(y, at[p], sizeof y);
                    y[c] += step * (q < 2 ? q - 2 : q - 1);
                    g[q] = (double)tetrahedron(&t, y, h, 0).gamma;
                }
                CHECK_WORST(check_words("grad gamma in 3D along %c, %s", "xyz"[c], name),
                            (double)(c == 0   ? one.gradient.x
                                     : c == 1 ? one.gradient.y
                                              : one.gradient.z) -
                                (8.0 * (g[2] - g[1]) - (g[3] - g[0])) / (12.0 * step),
                            BY_PRECISION(2e-5, 3e-1));
            }
        }
    }
}

/* ---- the sweep: points, a square and a cube as walls; on faces, edges and corners the limit from inside; lists; a periodic box ---- */

typedef struct box {
    sph_real corner[3][3][12]; /* corner a, b, c; axis; element */
    sph_wall_elements elements;
} box;
/* the unit interval, square or cube; open: without the walls across x */
static void box_make(box *b, int dim, int open)
{
    int axis, end, n = 0;
    memset(b, 0, sizeof *b);
    for (axis = open ? 1 : 0; axis < dim; axis++)
        for (end = 0; end < 2; end++) {
            const int u = (axis + 1) % dim, v = (axis + 2) % dim;
            int half, c;
            for (half = 0; half < (dim == 3 ? 2 : 1); half++, n++)
                for (c = 0; c < 3; c++) {
                    int k;
                    for (k = 0; k < 3; k++) b->corner[c][k][n] = SPH_R(0);
                    b->corner[c][axis][n] = SPH_R(end);
                    if (dim == 1 && c) b->corner[c][0][n] = SPH_R(end ? 2 : -1);
                    /* in order around the normal, which points along +axis at the end 1 */
                    if (dim == 2) b->corner[c][u][n] = SPH_R((c > 0) == ((axis == 0) == (end == 1)));
                    if (dim == 3) {
                        const int at = half ? (c == 0 ? 0 : c == 1 ? 3 : 2) : (c == 0 ? 0 : c == 1 ? 1 : 3);
                        b->corner[c][end ? u : v][n] = SPH_R(at & 1);
                        b->corner[c][end ? v : u][n] = SPH_R(at >> 1);
                        if (half) { /* 0, 3, 2 goes around the same way as 0, 1, 3 */
                            b->corner[c][end ? u : v][n] = SPH_R(c == 1);
                            b->corner[c][end ? v : u][n] = SPH_R(c > 0);
                        }
                    }
                }
        }
    b->elements.n = (sph_index)n;
    b->elements.a = sph_vectors_separate(b->corner[0][0], b->corner[0][1], b->corner[0][2]);
    b->elements.b = sph_vectors_separate(b->corner[1][0], b->corner[1][1], b->corner[1][2]);
    b->elements.c = sph_vectors_separate(b->corner[2][0], b->corner[2][1], b->corner[2][2]);
}
static sph_wall_gamma_out gamma_into(sph_real *gamma, sph_real *gradient, sph_index n)
{
    sph_wall_gamma_out o;
    o.gamma = gamma;
    o.gradient = sph_vector_out_separate(gradient, gradient + n, gradient + 2 * n);
    o.stride = 1;
    o.status = 0;
    return o;
}
static void test_sweep(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, dim == 3 ? 7 : 13, 1.3, 0.0, 1);
        sph_real *const gamma = (sph_real *)cloud_memory(8 * (size_t)c.n, sizeof *gamma), *const listed = gamma + c.n, *const gradient = gamma + 2 * c.n, *const other = gamma + 5 * c.n;
        sph_index *const start = (sph_index *)cloud_memory((size_t)c.n + 1, sizeof *start), *const index = (sph_index *)cloud_memory(12 * (size_t)c.n, sizeof *index);
        const double worst = BY_PRECISION(1e-7, 3e-3);
        box b;
        sph_index i;
        int e;
        box_make(&b, dim, 0);
        CHECK(sph_wall_gamma(SPH_WENDLAND_C4, dim, cloud_view(&c), b.elements, gamma_into(gamma, gradient, c.n)) == 0);
        for (i = 0; i < c.n; i++) { /* of the particles on one wall, an edge, a corner; the support is shorter than half of the box */
            double x[3];
            int k, walls = 0, inner = 1;
            cloud_position(&c, i, x);
            for (k = 0; k < dim; k++) {
                const double away = fmin(x[k], 1.0 - x[k]);
                walls += away <= 0.0;
                inner &= away <= 0.0 || away > 2.0 * (double)c.h;
            }
            if (inner) CHECK_NEAR(check_words("gamma in %dD on %d walls", dim, walls), i, gamma[i], pow(0.5, walls), worst);
            for (k = 0; k < dim; k++) { /* the gradient points away from the wall */
                if (x[k] <= 0.0) CHECK_AT("grad gamma", i, gradient[k * c.n + i] > SPH_R(0));
                if (x[k] >= 1.0) CHECK_AT("grad gamma", i, gradient[k * c.n + i] < SPH_R(0));
            }
        }
        for (i = 0; i < c.n; i++) { /* the elements in other order, by lists */
            for (e = 0; e < b.elements.n; e++) index[start[i] + e] = (sph_index)(b.elements.n - 1 - e);
            start[i + 1] = start[i] + b.elements.n;
        }
        b.elements.list.start = start;
        b.elements.list.index = index;
        CHECK(sph_wall_gamma(SPH_WENDLAND_C4, dim, cloud_view(&c), b.elements, gamma_into(listed, other, c.n)) == 0);
        for (i = 0; i < c.n; i++) CHECK_NEAR("gamma by lists", i, listed[i], gamma[i], 50.0 * EPSILON);
        /* a kernel without, and faults */
        CHECK(sph_wall_gamma(SPH_GAUSSIAN, dim, cloud_view(&c), b.elements, gamma_into(listed, other, c.n)) == SPH_ERROR_KERNEL);
        index[0] = (sph_index)b.elements.n;
        CHECK(sph_wall_gamma(SPH_WENDLAND_C4, dim, cloud_view(&c), b.elements, gamma_into(listed, other, c.n)) == SPH_ERROR_LIST);
        b.elements.n = -1;
        CHECK(sph_wall_gamma(SPH_WENDLAND_C4, dim, cloud_view(&c), b.elements, gamma_into(listed, other, c.n)) == SPH_ERROR_COUNT);
        b.elements.n = 0;
        b.elements.list.start = 0;
        CHECK(sph_wall_gamma(SPH_WENDLAND_C4, dim, cloud_view(&c), b.elements, gamma_into(listed, other, c.n)) == 0);
        for (i = 0; i < c.n; i++) CHECK_NEAR("gamma without walls", i, listed[i], 1.0, 0.0);
        free(start);
        free(index);
        free(gamma);
        cloud_free(&c);
    }
}
/* A channel that repeats along x: elements as long as a third of the period. Moved by any length, gamma stays. */
static void test_periodic(void)
{
    cloud c = cloud_lattice(2, 13, 1.1, 0.0, 1);
    sph_real *const gamma = (sph_real *)cloud_memory(4 * (size_t)c.n, sizeof *gamma), line[4][6], first[13];
    const sph_real h = SPH_R(0.07);
    sph_wall_elements walls;
    sph_points points = sph_points_periodic(cloud_points(&c), SPH_R(1), SPH_R(0), SPH_R(0));
    sph_index i;
    int e;
    memset(&walls, 0, sizeof walls);
    for (e = 0; e < 6; e++) { /* three below, to the right; three above, to the left */
        line[0][e] = SPH_R(0.4 + (e % 3 + (e > 2)) / 3.0);
        line[2][e] = SPH_R(0.4 + (e % 3 + (e < 3)) / 3.0);
        line[1][e] = line[3][e] = SPH_R(e > 2);
    }
    walls.n = 6;
    walls.a = sph_vectors_separate(line[0], line[1], 0);
    walls.b = sph_vectors_separate(line[2], line[3], 0);
    CHECK(sph_wall_gamma(SPH_CUBIC_SPLINE, 2, sph_cloud_of(points, cloud_list(&c), sph_scalars_same(&h), cloud_V(&c)), walls, gamma_into(gamma, gamma + c.n, c.n)) == 0);
    for (i = 0; i < 13; i++) first[i] = gamma[13 * i];
    CHECK_CLOSE((double)first[0], 0.5, BY_PRECISION(1e-7, 3e-3));
    CHECK((double)first[1] > 0.9 && (double)first[1] < 0.9999);
    CHECK_CLOSE((double)first[6], 1.0, 100.0 * EPSILON);
    for (i = 0; i < c.n; i++) CHECK_NEAR("gamma in a channel", i, gamma[i], first[i / 13], BY_PRECISION(1e-7, 1e-3));
    free(gamma);
    cloud_free(&c);
}

/* ---- operators ---- */

/* A lattice that begins at dx / 2 from the walls of the unit square. */
static cloud inner_lattice(int side, double h_over_dx)
{
    cloud c = cloud_new(2, (sph_index)(side * side));
    sph_index i;
    c.dx = 1.0 / side;
    c.h = SPH_R(h_over_dx * c.dx);
    for (i = 0; i < c.n; i++) {
        c.x[i] = SPH_R((i % side + 0.5) * c.dx);
        c.y[i] = SPH_R((i / side + 0.5) * c.dx);
        c.V[i] = SPH_R(c.dx * c.dx);
    }
    cloud_neighbors(&c, 2.05 * h_over_dx * c.dx);
    return c;
}
static void test_operators(void)
{
    static const double ratio[] = {1.3, 1.65, 2.0}, miss[] = {3.1e-2, 1.5e-2, 8.9e-3}, sum_form[] = {0.064, 0.027, 0.013};
    double before_laplacian = 1e9;
    int k;
    for (k = 0; k < 3; k++) {
        cloud c = inner_lattice(24, ratio[k]);
        const sph_index n = c.n;
        sph_real *const gamma = (sph_real *)cloud_memory(11 * (size_t)n, sizeof *gamma), *const gradient = gamma + n, *const sum = gamma + 4 * n, *const out = gamma + 5 * n, *const g = gamma + 8 * n;
        sph_wall_terms wall;
        double off = 0.0, wrong = 0.0, difference = 0.0, without = 0.0, laplacian = 0.0, bare = 0.0;
        box b;
        sph_index i;
        box_make(&b, 2, 0);
        memset(&wall, 0, sizeof wall);
        CHECK(sph_wall_gamma(SPH_WENDLAND_C2, 2, cloud_view(&c), b.elements, gamma_into(gamma, gradient, n)) == 0);
        CHECK(sph_shepard_sum(SPH_WENDLAND_C2, 2, cloud_view(&c), sph_scalar_out_array(sum, 0)) == 0);
        for (i = 0; i < n; i++) off = worse(off, (double)(sum[i] - gamma[i]) * (fabs((double)c.x[i] - 0.5) < 0.2));
        CHECK_CLOSE(off, miss[k], 0.05 * miss[k]);
        /* f = x: near the wall at 0, where f_w = 0; in difference form near both */
        wall.gamma = sph_scalars_array(gamma);
        wall.gradient = sph_vectors_separate(gradient, gradient + n, 0);
        wall.value = sph_scalars_array(g);
        for (i = 0; i < n; i++) g[i] = SPH_R((double)c.x[i] > 0.5);
        CHECK(sph_wall_gradient(SPH_WENDLAND_C2, 2, cloud_view(&c), wall, sph_scalars_array(c.x), sph_vector_out_separate(out, out + n, 0)) == 0);
        for (i = 0; i < n; i++) wrong = worse(wrong, ((double)out[i] - 1.0) * (fabs((double)c.y[i] - 0.5) < 0.2 && (double)c.x[i] < 2.0 * (double)c.h));
        CHECK_CLOSE(wrong, sum_form[k], 0.05 * sum_form[k]);
        CHECK(sph_gradient_difference(SPH_WENDLAND_C2, 2, cloud_view(&c), sph_scalars_array(c.x), sph_vector_out_separate(out, out + n, 0)) == 0);
        for (i = 0; i < n; i++) {
            const sph_vec at = vec((double)out[i], (double)out[n + i], 0.0), nabla = vec((double)gradient[i], (double)gradient[n + i], 0.0);
            if (fabs((double)c.y[i] - 0.5) > 0.2) continue;
            difference = worse(difference, (double)sph_wall_gradient_value(2, at, g[i] - c.x[i], gamma[i], nabla).x - 1.0);
            without = worse(without, (double)out[i] - 1.0);
        }
        CHECK(difference < 0.12);
        CHECK(without > 0.4); /* negative control: half of the support is missing */
        /* lap (x^2 + 3 x) = 2, with the gradient at the wall given */
        for (i = 0; i < n; i++) {
            c.f[i] = SPH_R(square((double)c.x[i]) + 3.0 * (double)c.x[i]);
            g[i] = SPH_R((double)c.x[i] > 0.5 ? 5.0 : 3.0);
            g[n + i] = SPH_R(0);
        }
        wall.slope = sph_vectors_separate(g, g + n, 0);
        CHECK(sph_wall_laplacian(SPH_WENDLAND_C2, 2, cloud_view(&c), wall, cloud_f(&c), sph_scalar_out_array(out, 0)) == 0);
        for (i = 0; i < n; i++) laplacian = worse(laplacian, ((double)out[i] - 2.0) * (fabs((double)c.y[i] - 0.5) < 0.2));
        CHECK(sph_laplacian_brookshaw(SPH_WENDLAND_C2, 2, cloud_view(&c), cloud_f(&c), sph_scalar_out_array(out, 0)) == 0);
        for (i = 0; i < n; i++) bare = worse(bare, ((double)out[i] - 2.0) * (fabs((double)c.y[i] - 0.5) < 0.2));
        CHECK(bare > 10.0 * laplacian && laplacian < before_laplacian);
        before_laplacian = laplacian;
        free(gamma);
        cloud_free(&c);
    }
}
/* What can be applied can also be given as rows: both agree to rounding, in all dimensions, for a state of the wall that is any. */
static void test_rows(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        cloud c = cloud_lattice(dim, dim == 1 ? 40 : dim == 2 ? 12 : 7, 1.4, 0.2, 8);
        const sph_index n = c.n, pairs = c.start[n];
        sph_real *const a = (sph_real *)cloud_memory(18 * (size_t)n + 3 * (size_t)pairs, sizeof *a), *const gamma = a, *const nabla = a + n, *const slope = a + 4 * n, *const value = a + 7 * n,
                        *const out = a + 8 * n, *const source = a + 11 * n, *const applied = a + 14 * n, *const diagonal = a + 15 * n, *const conditioning = a + 16 * n, *const factor = a + 17 * n,
                        *const row = a + 18 * n;
        unsigned char *const status = (unsigned char *)cloud_memory((size_t)n, 1);
        double off = 0.0, size = 0.0, laplacian = 0.0, laplacian_size = 0.0;
        sph_gradient_rows_out rows = {0};
        sph_rows_out r = {0};
        sph_wall_terms wall;
        sph_index i;
        pcg32 g;
        int k;
        pcg32_seed(&g, 4, (uint64_t)dim);
        cloud_set(&c, field_smooth);
        for (i = 0; i < 8 * n; i++) a[i] = SPH_R(i < n ? 0.6 + 0.4 * pcg32_uniform(&g) : cloud_symmetric(&g));
        memset(&wall, 0, sizeof wall);
        wall.gamma = sph_scalars_array(gamma);
        wall.gradient = sph_vectors_separate(nabla, nabla + n, nabla + 2 * n);
        wall.value = sph_scalars_array(value);
        wall.slope = sph_vectors_separate(slope, slope + n, slope + 2 * n);
        rows.x = row, rows.y = row + pairs, rows.z = row + 2 * pairs, rows.conditioning = conditioning, rows.status = status;
        CHECK(sph_wall_gradient(SPH_WENDLAND_C2, dim, cloud_view(&c), wall, cloud_f(&c), sph_vector_out_separate(out, out + n, out + 2 * n)) == 0);
        CHECK(sph_wall_gradient_rows(SPH_WENDLAND_C2, dim, cloud_view(&c), wall, rows, sph_vector_out_separate(source, source + n, source + 2 * n)) == 0);
        for (k = 0; k < dim; k++) {
            sph_real *const zero = diagonal; /* these rows multiply f_j */
            for (i = 0; i < n; i++) zero[i] = SPH_R(0);
            CHECK(sph_rows_apply(cloud_view(&c), row + k * pairs, sph_scalars_array(zero), cloud_f(&c), sph_scalar_out_array(applied, 0)) == 0);
            for (i = 0; i < n; i++) {
                off = worse(off, (double)(applied[i] + source[i + k * n] - out[i + k * n]));
                size = worse(size, (double)out[i + k * n]);
                CHECK(status[i] == SPH_OK && (double)conditioning[i] == 1.0);
            }
        }
        CHECK(size > 1.0);
        CHECK_WORST("rows of the wall's gradient", off / size, 200.0 * EPSILON);
        CHECK(sph_wall_laplacian(SPH_WENDLAND_C2, dim, cloud_view(&c), wall, cloud_f(&c), sph_scalar_out_array(out, 0)) == 0);
        r.row = row, r.diagonal = diagonal, r.factor = factor, r.conditioning = conditioning, r.status = status;
        CHECK(sph_wall_laplacian_rows(SPH_WENDLAND_C2, dim, cloud_view(&c), wall, r, sph_scalar_out_array(source, 0)) == 0);
        CHECK(sph_rows_apply(cloud_view(&c), row, sph_scalars_array(diagonal), cloud_f(&c), sph_scalar_out_array(applied, 0)) == 0);
        for (i = 0; i < n; i++) {
            laplacian = worse(laplacian, (double)(applied[i] + source[i] - out[i]));
            laplacian_size = worse(laplacian_size, (double)diagonal[i]);
            CHECK(status[i] == SPH_OK && (double)factor[i] == 1.0 && (double)diagonal[i] < 0.0);
        }
        CHECK(sph_rows_monotone(cloud_view(&c), row, sph_scalars_array(diagonal), 0) == 0);
        CHECK_WORST("rows of the wall's Laplacian", laplacian / laplacian_size, 200.0 * EPSILON);
        /* what the wall adds to one target overflows: it is 0, its row too, and the others stay */
        gamma[1] = SPH_R(BY_PRECISION(1e-300, 1e-30));
        value[1] = SPH_R(1e30);
        CHECK(sph_wall_gradient_rows(SPH_WENDLAND_C2, dim, cloud_view(&c), wall, rows, sph_vector_out_separate(source, source + n, source + 2 * n)) == 1);
        CHECK(status[1] == SPH_NOT_FINITE && status[0] == SPH_OK && row[c.start[1]] == SPH_R(0) && source[1] == SPH_R(0));
        free(a);
        free(status);
        cloud_free(&c);
    }
}
/* In 1D, with the Shepard sum for gamma, it is the boundary integral method. */
static void test_bim(void)
{
    cloud c = cloud_random_1d(60, 1.2, 4);
    const sph_index n = c.n;
    sph_real *const gamma = (sph_real *)cloud_memory(7 * (size_t)n, sizeof *gamma), *const gradient = gamma + n, *const slope = gamma + 4 * n, *const bim = gamma + 5 * n, *const out = gamma + 6 * n;
    sph_wall_terms wall;
    double off = 0.0, size = 0.0;
    box b;
    sph_index i;
    box_make(&b, 1, 0);
    memset(&wall, 0, sizeof wall);
    cloud_set(&c, field_smooth);
    CHECK(sph_wall_gamma(SPH_CUBIC_SPLINE, 1, cloud_view(&c), b.elements, gamma_into(gamma, gradient, n)) == 0);
    CHECK(sph_shepard_sum(SPH_CUBIC_SPLINE, 1, cloud_view(&c), sph_scalar_out_array(gamma, 0)) == 0);
    for (i = 1; i < n - 1; i++) {
        const sph_index end = (double)c.x[i] > 0.5 ? n - 1 : 0;
        slope[i] = (c.f[end] - c.f[i]) / (c.x[end] - c.x[i]);
    }
    wall.gamma = sph_scalars_array(gamma);
    wall.gradient = sph_vectors_separate(gradient, 0, 0);
    wall.slope = sph_vectors_separate(slope, 0, 0);
    CHECK(sph_second_derivative_bim(SPH_CUBIC_SPLINE, cloud_view(&c), cloud_f(&c), 0, n - 1, sph_scalar_out_array(bim, 0)) == 2);
    CHECK(sph_wall_laplacian(SPH_CUBIC_SPLINE, 1, cloud_view(&c), wall, cloud_f(&c), sph_scalar_out_array(out, 0)) == 0);
    for (i = 1; i < n - 1; i++)
        if (fabs((double)c.x[i] - 0.5) > 2.0 * (double)c.h - 0.5 && (double)c.h < 0.2) {
            off = worse(off, (double)(out[i] - bim[i]));
            size = worse(size, (double)bim[i]);
        }
    CHECK(size > 1.0);
    CHECK_WORST("Laplacian in 1D beside BIM", off, BY_PRECISION(1e-9, 1e-3) * size);
    free(gamma);
    cloud_free(&c);
}

int main(void)
{
    test_which();
    test_points();
    test_segments();
    test_lattice();
    test_triangles();
    test_sweep();
    test_periodic();
    test_operators();
    test_rows();
    test_bim();
    return check_report("test_walls");
}
