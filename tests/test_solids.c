/* SPDX-License-Identifier: MIT */
/*
 * test_solids.c - solids in total Lagrangian form: affine maps and rotations are exact, laws are derivatives of their energies, momentum and angular momentum (without L in the force
 * the latter is lost), power, the force of a linear stress, hourglass control, a row of particles in the plane.
 */
#include "one_copy.h"

#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <string.h>

#define KERNEL SPH_WENDLAND_C2
#define EPSILON ((double)SPH_EPSILON)

static const int sides[4] = {0, 31, 16, 8};
static double worse(double a, double b) { return fabs(b) <= a ? a : fabs(b); }

/* ---- a solid: the cloud is its reference state ---- */

typedef struct body {
    cloud c;
    sph_real *memory, *x[3], *a[3], *h, *density, *modulus, *inverse, *gradient, *stress, *one;
    unsigned char *status;
    sph_elastic law;
} body;

static body body_of(cloud c, uint64_t seed)
{
    body b;
    const size_t n = (size_t)c.n;
    pcg32 g;
    sph_index i;
    int k;
    b.c = c;
    b.memory = (sph_real *)cloud_memory(45 * n, sizeof *b.memory);
    for (k = 0; k < 3; k++) {
        b.x[k] = b.memory + (size_t)k * n;
        b.a[k] = b.memory + (size_t)(3 + k) * n;
    }
    b.h = b.memory + 6 * n;
    b.density = b.memory + 7 * n;
    b.modulus = b.memory + 8 * n;
    b.inverse = b.memory + 9 * n;
    b.gradient = b.memory + 18 * n;
    b.stress = b.memory + 27 * n;
    b.one = b.memory + 36 * n;
    b.status = (unsigned char *)cloud_memory(n, 1);
    b.law.first = SPH_R(1.1);
    b.law.shear = SPH_R(0.9);
    pcg32_seed(&g, seed, 3);
    for (i = 0; i < c.n; i++) {
        b.h[i] = c.h * SPH_R(1.0 - 0.2 * (i % 3) / 2.0);
        b.density[i] = SPH_R(1.5 + cloud_symmetric(&g));
        b.modulus[i] = SPH_R(50.0 * (1.0 + 0.5 * cloud_symmetric(&g)));
        for (k = 0; k < c.dim; k++) b.one[((int)i * c.dim + k) * c.dim + k] = SPH_R(1);
        b.x[0][i] = c.x[i];
        b.x[1][i] = c.y[i];
        b.x[2][i] = c.z[i];
    }
    return b;
}
static void body_free(body *b)
{
    cloud_free(&b->c);
    free(b->memory);
    free(b->status);
}
static sph_cloud view(const body *b) { return sph_cloud_of(cloud_points(&b->c), cloud_list(&b->c), sph_scalars_array(b->h), cloud_V(&b->c)); }
static sph_points current(const body *b) { return sph_points_separate(b->c.n, b->x[0], b->x[1], b->x[2]); }
static sph_matrices packed(const body *b, const sph_real *p) { return sph_matrices_packed(b->c.dim, p); }
static sph_vector_out acceleration(const body *b) { return sph_vector_out_separate(b->a[0], b->a[1], b->a[2]); }
static sph_mat at(const body *b, const sph_real *p, sph_index i) { return sphi_matrix_at(b->c.dim, packed(b, p), i); }
static double entry(const body *b, const sph_real *p, sph_index i, int r, int c) { return (double)p[((int)i * b->c.dim + r) * b->c.dim + c]; }
static sph_solid solid_of(const body *b, double hourglass)
{
    sph_solid s;
    memset(&s, 0, sizeof s);
    s.inverse = packed(b, b->inverse);
    s.stress = packed(b, b->stress);
    s.density = sph_scalars_array(b->density);
    s.hourglass = SPH_R(hourglass);
    s.x = current(b);
    s.gradient = packed(b, b->gradient);
    s.modulus = sph_scalars_array(b->modulus);
    return s;
}
static int prepare(const body *b)
{
    sph_correction_out o;
    memset(&o, 0, sizeof o);
    o.inverse = sph_matrix_out_packed(b->c.dim, b->inverse);
    o.status = b->status;
    return (int)sph_gradient_correction_cspm(KERNEL, b->c.dim, view(b), o);
}
static void put_stress(const body *b, sph_index i, sph_mat p)
{
    sphi_store_matrix(b->c.dim, sph_matrix_out_packed(b->c.dim, b->stress), i, p);
}
/* F, and the stress by one of the laws */
static void strain(const body *b, int neo)
{
    const int dim = b->c.dim;
    sph_index i;
    CHECK(sph_deformation_gradient(KERNEL, dim, view(b), current(b), packed(b, b->inverse), sph_matrix_out_packed(dim, b->gradient)) == 0);
    for (i = 0; i < b->c.n; i++)
        put_stress(b, i, neo ? sph_stress_neo_hookean(dim, at(b, b->gradient, i), b->law) : sph_stress_saint_venant_kirchhoff(dim, at(b, b->gradient, i), b->law));
}
/* x = map X + shift */
static void deform(const body *b, double map[3][3])
{
    sph_index i;
    int r, c;
    for (i = 0; i < b->c.n; i++) {
        double p[3];
        cloud_position(&b->c, i, p);
        for (r = 0; r < b->c.dim; r++) {
            double s = 0.1 * (r + 1);
            for (c = 0; c < b->c.dim; c++) s += map[r][c] * p[c];
            b->x[r][i] = SPH_R(s);
        }
    }
}
static void totals(const body *b, double *push, double *twist, double *size)
{
    sph_index i;
    int k;
    for (k = 0; k < 3; k++) push[k] = twist[k] = 0.0;
    *size = 0.0;
    for (i = 0; i < b->c.n; i++) {
        const double m = (double)b->density[i] * (double)b->c.V[i];
        double F[3] = {0.0, 0.0, 0.0}, x[3] = {0.0, 0.0, 0.0};
        for (k = 0; k < b->c.dim; k++) {
            F[k] = m * (double)b->a[k][i];
            x[k] = (double)b->x[k][i];
            push[k] += F[k];
            *size += fabs(F[k]);
        }
        for (k = 0; k < 3; k++) twist[k] += x[(k + 1) % 3] * F[(k + 2) % 3] - x[(k + 2) % 3] * F[(k + 1) % 3];
    }
}
/* a random displacement of up to `much` dx */
static void shake(const body *b, double much, uint64_t seed)
{
    pcg32 g;
    sph_index i;
    int k;
    pcg32_seed(&g, seed, 31);
    for (i = 0; i < b->c.n; i++)
        for (k = 0; k < b->c.dim; k++) b->x[k][i] += SPH_R(much * b->c.dx * cloud_symmetric(&g));
}
static double strongest(const body *b)
{
    double s = 0.0;
    sph_index i;
    int k;
    for (i = 0; i < b->c.n; i++)
        for (k = 0; k < b->c.dim; k++) s = worse(s, (double)b->a[k][i]);
    return s;
}

/* ---- affine maps and rotations ---- */

static void test_affine(void)
{
    static double map[3][3] = {{1.2, 0.3, -0.1}, {-0.2, 0.9, 0.25}, {0.15, -0.05, 1.1}};
    const double c = cos(0.7), s = sin(0.7);
    double turn[3][3] = {{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}};
    int dim, neo;
    for (dim = 1; dim <= 3; dim++) {
        body b = body_of(cloud_lattice(dim, sides[dim], 1.7, 0.25, 4), 7);
        double off = 0.0, force = 0.0;
        sph_index i;
        int k, l;
        cloud_random_volumes(&b.c, 5);
        CHECK(prepare(&b) == 0);
        deform(&b, map);
        strain(&b, 0);
        for (i = 0; i < b.c.n; i++)
            for (k = 0; k < dim; k++)
                for (l = 0; l < dim; l++) off = worse(off, entry(&b, b.gradient, i, k, l) - map[k][l]);
        CHECK_WORST(check_words("F of an affine map in %dD", dim), off, BY_PRECISION(1e-12, 3e-4));
        /* hourglass control leaves affine maps alone */
        memset(b.stress, 0, 9 * (size_t)b.c.n * sizeof *b.stress);
        CHECK(sph_solid_acceleration(KERNEL, dim, view(&b), solid_of(&b, 1.0), acceleration(&b)) == 0);
        CHECK_WORST(check_words("hourglass control of an affine map in %dD", dim), strongest(&b), BY_PRECISION(2e-10, 0.3));
        for (neo = 0; dim > 1 && neo < 2; neo++) {
            deform(&b, turn);
            strain(&b, neo);
            for (off = 0.0, i = 0; i < b.c.n; i++)
                for (k = 0; k < dim; k++)
                    for (l = 0; l < dim; l++) off = worse(off, entry(&b, b.gradient, i, k, l) - turn[k][l]);
            CHECK_WORST(check_words("F of a rotation in %dD", dim), off, BY_PRECISION(1e-12, 3e-4));
            CHECK(sph_solid_acceleration(KERNEL, dim, view(&b), solid_of(&b, 1.0), acceleration(&b)) == 0);
            CHECK_WORST(check_words("force of a rotation in %dD", dim), strongest(&b), BY_PRECISION(1e-9, 1.0));
            shake(&b, 0.1, 3);
            strain(&b, neo);
            CHECK(sph_solid_acceleration(KERNEL, dim, view(&b), solid_of(&b, 1.0), acceleration(&b)) == 0);
            force = strongest(&b);
            CHECK(force > 10.0); /* the scale of what is 0 above */
        }
        body_free(&b);
    }
}

/* ---- the laws are derivatives of their energies, and do not depend on the observer ---- */

static double determinant(double f[3][3])
{
    return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) + f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}
static double energy_of(int neo, int dim, double f[3][3], double lambda, double mu)
{
    double trace = 0.0, square = 0.0, full[3][3];
    int a, b, c;
    for (a = 0; a < 3; a++)
        for (b = 0; b < 3; b++) full[a][b] = a < dim && b < dim ? f[a][b] : a == b ? 1.0 : 0.0;
    for (a = 0; a < dim; a++)
        for (b = 0; b < dim; b++) {
            double e = a == b ? -0.5 : 0.0;
            for (c = 0; c < dim; c++) e += 0.5 * f[c][a] * f[c][b];
            if (a == b) trace += e;
            square += e * e;
        }
    if (neo) {
        const double j = log(determinant(full));
        return mu * (trace - j) + 0.5 * lambda * j * j; /* tr(F^T F) - dim = 2 tr E */
    }
    return 0.5 * lambda * trace * trace + mu * square;
}
static sph_mat mat_of(int dim, double f[3][3])
{
    sph_mat m;
    memset(&m, 0, sizeof m);
    m.x.x = SPH_R(f[0][0]);
    if (dim > 1) m.x.y = SPH_R(f[0][1]), m.y.x = SPH_R(f[1][0]), m.y.y = SPH_R(f[1][1]);
    if (dim > 2) m.x.z = SPH_R(f[0][2]), m.y.z = SPH_R(f[1][2]), m.z.x = SPH_R(f[2][0]), m.z.y = SPH_R(f[2][1]), m.z.z = SPH_R(f[2][2]);
    return m;
}
static void test_laws(void)
{
    const sph_elastic law = sph_elastic_of(SPH_R(2.6), SPH_R(0.3)), rod = sph_elastic_of(SPH_R(2.0), SPH_R(0));
    const double lambda = (double)law.first, mu = (double)law.shear;
    pcg32 g;
    int dim, neo, r, c, k;
    CHECK_RELATIVE(mu, 1.0, 4.0 * EPSILON);
    CHECK_RELATIVE(lambda, 1.5, 8.0 * EPSILON);
    CHECK_RELATIVE((double)rod.shear, 1.0, 4.0 * EPSILON);
    CHECK((double)rod.first == 0.0);
    CHECK_RELATIVE((double)sph_sound_speed_elastic(law, SPH_R(0.875)), 2.0, 8.0 * EPSILON);
    pcg32_seed(&g, 5, 5);
    for (dim = 1; dim <= 3; dim++)
        for (neo = 0; neo < 2; neo++)
            for (k = 0; k < 10; k++) {
                double f[3][3], p[3][3];
                sph_mat P, turned;
                for (r = 0; r < 3; r++)
                    for (c = 0; c < 3; c++) f[r][c] = (r == c ? 1.0 : 0.0) + (k == 0 ? 0.0 : 0.3 * cloud_symmetric(&g));
                P = neo ? sph_stress_neo_hookean(dim, mat_of(dim, f), law) : sph_stress_saint_venant_kirchhoff(dim, mat_of(dim, f), law);
                p[0][0] = (double)P.x.x, p[0][1] = (double)P.x.y, p[0][2] = (double)P.x.z;
                p[1][0] = (double)P.y.x, p[1][1] = (double)P.y.y, p[1][2] = (double)P.y.z;
                p[2][0] = (double)P.z.x, p[2][1] = (double)P.z.y, p[2][2] = (double)P.z.z;
                for (r = 0; r < 3; r++)
                    for (c = 0; c < 3; c++) {
                        const double eps = 1e-5, was = f[r][c];
                        double more, less;
                        if (r >= dim || c >= dim) {
                            CHECK(p[r][c] == 0.0);
                            continue;
                        }
                        f[r][c] = was + eps;
                        more = energy_of(neo, dim, f, lambda, mu);
                        f[r][c] = was - eps;
                        less = energy_of(neo, dim, f, lambda, mu);
                        f[r][c] = was;
                        CHECK_CLOSE(p[r][c], (more - less) / (2.0 * eps), BY_PRECISION(1e-8, 1e-5));
                        if (k == 0) CHECK_CLOSE(p[r][c], 0.0, 8.0 * EPSILON);
                    }
                if (dim < 2) continue;
                { /* P(R F) = R P(F) */
                    const double co = cos(1.1), si = sin(1.1);
                    double q[3][3], rp[2];
                    for (c = 0; c < 3; c++) {
                        q[0][c] = co * f[0][c] - si * f[1][c];
                        q[1][c] = si * f[0][c] + co * f[1][c];
                        q[2][c] = f[2][c];
                    }
                    turned = neo ? sph_stress_neo_hookean(dim, mat_of(dim, q), law) : sph_stress_saint_venant_kirchhoff(dim, mat_of(dim, q), law);
                    rp[0] = co * p[0][0] - si * p[1][0];
                    rp[1] = si * p[0][1] + co * p[1][1];
                    CHECK_CLOSE((double)turned.x.x, rp[0], 100.0 * EPSILON);
                    CHECK_CLOSE((double)turned.y.y, rp[1], 100.0 * EPSILON);
                }
            }
}

/* ---- momentum, angular momentum, power ---- */

static void test_conservation(void)
{
    static double map[3][3] = {{1.2, 0.3, -0.1}, {-0.2, 0.9, 0.25}, {0.15, -0.05, 1.1}};
    int dim, neo, controlled, axis;
    for (dim = 1; dim <= 3; dim++)
        for (neo = 0; neo < 2; neo++)
            for (controlled = 0; controlled < 2; controlled++) {
                body b = body_of(cloud_lattice(dim, sides[dim], 1.7, 0.2, 4), 7);
                sph_real *const f = (sph_real *)cloud_memory((size_t)(b.c.n * dim * dim), sizeof *f), *const v = (sph_real *)cloud_memory(3 * (size_t)b.c.n, sizeof *v);
                double push[3], twist[3], size, plain = 0.0, power = 0.0, work = 0.0, power_size = 0.0;
                pcg32 g;
                sph_index i;
                int k, l;
                cloud_random_volumes(&b.c, 5);
                CHECK(prepare(&b) == 0);
                deform(&b, map);
                shake(&b, 0.15, 9);
                strain(&b, neo);
                CHECK(sph_solid_acceleration(KERNEL, dim, view(&b), solid_of(&b, controlled ? 1.0 : 0.0), acceleration(&b)) == 0);
                totals(&b, push, twist, &size);
                CHECK(size > 0.0);
                for (k = 0; k < dim; k++) CHECK_WORST(check_words("force on all in %dD", dim), push[k], 50.0 * EPSILON * size);
                for (k = 0; k < 3; k++) CHECK_WORST(check_words("torque on all in %dD", dim), twist[k], 100.0 * EPSILON * size);
                { /* sum V P : dF/dt, and the rate of the energy of the control, are -sum m a . v. F is linear in x: its rate is the difference that x + v makes */
                    pcg32_seed(&g, 8, 8);
                    for (i = 0; i < b.c.n; i++)
                        for (k = 0; k < dim; k++) {
                            const sph_real was = b.x[k][i];
                            b.x[k][i] += SPH_R(b.c.dx * cloud_symmetric(&g));
                            v[3 * i + k] = b.x[k][i] - was;
                        }
                    CHECK(sph_deformation_gradient(KERNEL, dim, view(&b), current(&b), packed(&b, b.inverse), sph_matrix_out_packed(dim, f)) == 0);
                    for (i = 0; i < b.c.n; i++)
                        for (k = 0; k < dim; k++) {
                            const double w = (double)b.density[i] * (double)b.c.V[i] * (double)b.a[k][i] * (double)v[3 * i + k];
                            work += w;
                            power_size += fabs(w);
                            b.x[k][i] -= v[3 * i + k];
                            for (l = 0; l < dim; l++) power += (double)b.c.V[i] * entry(&b, b.stress, i, k, l) * (entry(&b, f, i, k, l) - entry(&b, b.gradient, i, k, l));
                        }
                    for (i = 0; controlled && i < b.c.n; i++) {
                        sph_index p;
                        for (p = b.c.start[i]; p < b.c.start[i + 1]; p++) {
                            const sph_index j = b.c.index[p];
                            const sph_vec X = sph_subtract(dim, sphi_point(dim, cloud_points(&b.c), i), sphi_point(dim, cloud_points(&b.c), j));
                            const double F = (double)sph_kernel_f(KERNEL, dim, sph_length(dim, X), b.h[i]), at_X[3] = {(double)X.x, (double)X.y, (double)X.z};
                            for (k = 0; k < dim; k++) {
                                double e = -(double)(b.x[k][i] - b.x[k][j]), rate = -(double)(v[3 * i + k] - v[3 * j + k]);
                                for (l = 0; l < dim; l++) {
                                    e += entry(&b, b.gradient, i, k, l) * at_X[l];
                                    rate += (entry(&b, f, i, k, l) - entry(&b, b.gradient, i, k, l)) * at_X[l];
                                }
                                power += 0.5 * (double)b.c.V[i] * (double)b.c.V[j] * (double)b.modulus[i] * -F * e * rate;
                            }
                        }
                    }
                    CHECK_WORST(check_words("power in %dD", dim), work + power, 500.0 * EPSILON * power_size);
                    CHECK(fabs(work) > 1e-3 * power_size);
                }
                if (!controlled && dim > 1) { /* negative control: without L in the force, as it is often written, angular momentum is lost */
                    sph_solid s = solid_of(&b, 0.0);
                    s.inverse = packed(&b, b.one);
                    CHECK(sph_solid_acceleration(KERNEL, dim, view(&b), s, acceleration(&b)) == 0);
                    totals(&b, push, twist, &size);
                    for (axis = 0; axis < 3; axis++) plain = worse(plain, twist[axis]);
                    CHECK(plain > 1e-4 * size);
                    CHECK_WORST("force on all without L", push[0], 50.0 * EPSILON * size);
                }
                free(f);
                free(v);
                body_free(&b);
            }
}

/* ---- inside a lattice the force of a linear stress is its divergence over the density, with an h and a density that are the same for all ---- */

static void test_divergence(void)
{
    static const double slope[3][3][3] = {{{0.3, 0.1, -0.2}, {0.5, -0.4, 0.2}, {0.1, 0.6, 0.7}}, {{-0.5, 0.2, 0.4}, {0.3, 0.8, -0.1}, {0.2, 0.2, 0.9}}, {{0.4, 0.3, 0.1}, {0.6, -0.2, 0.5}, {0.7, 0.1, -0.3}}};
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        body b = body_of(cloud_lattice(dim, 14, 1.4, 0.0, 1), 7);
        const sph_cloud all = cloud_view(&b.c);
        int counted = 0, k, l, m;
        sph_index i;
        for (i = 0; i < b.c.n; i++) {
            double p[3], f[3][3];
            cloud_position(&b.c, i, p);
            b.c.V[i] = SPH_R(pow(b.c.dx, dim));
            b.density[i] = SPH_R(2.5);
            b.h[i] = b.c.h;
            for (k = 0; k < 3; k++)
                for (l = 0; l < 3; l++)
                    for (f[k][l] = 1.0, m = 0; m < dim; m++) f[k][l] += slope[k][l][m] * p[m];
            put_stress(&b, i, mat_of(dim, f));
        }
        CHECK(prepare(&b) == 0);
        CHECK(sph_solid_acceleration(KERNEL, dim, all, solid_of(&b, 0.0), acceleration(&b)) == 0);
        for (i = 0; i < b.c.n; i++) {
            double p[3], inside = 1.0;
            cloud_position(&b.c, i, p);
            for (k = 0; k < dim; k++) inside = fmin(inside, fmin(p[k], 1.0 - p[k]));
            if (inside < 0.44) continue; /* two supports are 0.431 */
            counted++;
            for (k = 0; k < dim; k++) {
                double expected = 0.0;
                for (l = 0; l < dim; l++) expected += slope[k][l][l] / 2.5;
                CHECK_NEAR(check_words("div P / rho in %dD", dim), i, b.a[k][i], expected, BY_PRECISION(1e-12, 2e-4));
            }
        }
        CHECK(counted > 0);
        body_free(&b);
    }
}

/* ---- a checkerboard: stress does not see it inside; hourglass control pulls it back, and two particles that are too far apart attract ---- */

static void test_hourglass(void)
{
    int dim;
    for (dim = 1; dim <= 3; dim++) {
        body b = body_of(cloud_lattice(dim, dim == 3 ? 10 : 18, 1.6, 0.0, 1), 7);
        double by_stress = 0.0, by_control = 0.0, work = 0.0, inside_work = 0.0;
        sph_index i;
        int pass, k;
        for (i = 0; i < b.c.n; i++) {
            const int side = b.c.side, q = (int)i % side + (int)i / side % side + (int)i / side / side;
            b.h[i] = b.c.h;
            b.density[i] = SPH_R(1);
            b.modulus[i] = SPH_R(50);
            b.c.V[i] = SPH_R(pow(b.c.dx, dim));
            b.x[0][i] += SPH_R(0.1 * b.c.dx * (q % 2 ? 1.0 : -1.0));
        }
        CHECK(prepare(&b) == 0);
        strain(&b, 0);
        for (pass = 0; pass < 2; pass++) {
            CHECK(sph_solid_acceleration(KERNEL, dim, view(&b), solid_of(&b, pass ? 1.0 : 0.0), acceleration(&b)) == 0);
            for (i = 0; i < b.c.n; i++) {
                const double moved = (double)(b.x[0][i] - b.c.x[i]), a = (double)b.a[0][i];
                double p[3], inside = 1.0;
                cloud_position(&b.c, i, p);
                for (k = 0; k < dim; k++) inside = fmin(inside, fmin(p[k], 1.0 - p[k]));
                if (pass) work += a * moved;
                else work -= a * moved;
                if (inside < 4.2 * 1.6 * b.c.dx && dim < 3) continue; /* F of neighbours counts */
                if (inside < 2.1 * 1.6 * b.c.dx) continue;
                if (pass) {
                    by_control = worse(by_control, a);
                    inside_work += a * moved;
                } else if (dim < 3) by_stress = worse(by_stress, a);
            }
        }
        CHECK(work < 0.0); /* what the control does goes against the checkerboard: its energy falls */
        if (dim < 3) {
            CHECK_WORST(check_words("stress of a checkerboard in %dD", dim), by_stress, BY_PRECISION(1e-11, 1e-2));
            CHECK(by_control > 1.0);
            CHECK(inside_work < 0.0);
        }
        body_free(&b);
    }
    { /* by hand: F = 1 on both sides, E = 3 and 5, too far apart along x by 0.5, and off the line by 0.25 */
        sph_solid_side i, j;
        sph_pair_kernel kernel;
        sph_vec X, x, f;
        memset(&i, 0, sizeof i);
        memset(&kernel, 0, sizeof kernel);
        i.gradient.x.x = i.gradient.y.y = i.gradient.z.z = SPH_R(1);
        j = i;
        i.modulus = SPH_R(3);
        j.modulus = SPH_R(5);
        kernel.f_i = SPH_R(-1);
        kernel.f_j = SPH_R(-2);
        X.x = SPH_R(-2); /* x_ij = x_i - x_j: j is on the right */
        X.y = X.z = SPH_R(0);
        x = X;
        x.x = SPH_R(-2.5);
        x.y = SPH_R(0.25);
        f = sph_hourglass_pair(2, i, j, SPH_R(1), X, x, kernel); /* e = (0.5, -0.25): (3 + 10) / 2 e */
        CHECK_CLOSE((double)f.x, 3.25, 16.0 * EPSILON);
        CHECK_CLOSE((double)f.y, -1.625, 16.0 * EPSILON);
        x.x = SPH_R(-1.5);
        CHECK_CLOSE((double)sph_hourglass_pair(2, i, j, SPH_R(1), X, x, kernel).x, -3.25, 16.0 * EPSILON);
    }
}

/* ---- a row of particles in the plane: no second direction, no stress; a box that repeats and is stretched ---- */

static void test_degenerate(void)
{
    body b = body_of(cloud_new(2, 6), 1);
    sph_index i;
    b.c.dx = 1.0;
    for (i = 0; i < 6; i++) {
        b.c.x[i] = b.x[0][i] = SPH_R(i);
        b.c.V[i] = SPH_R(1);
        b.h[i] = b.c.h = SPH_R(1.5);
    }
    cloud_neighbors(&b.c, 3.1);
    CHECK(prepare(&b) == 6);
    shake(&b, 0.3, 2);
    strain(&b, 1);
    CHECK(sph_solid_acceleration(KERNEL, 2, view(&b), solid_of(&b, 0.0), acceleration(&b)) == 0);
    for (i = 0; i < 6; i++) {
        CHECK_SAME("status of a row", i, b.status[i], SPH_SINGULAR);
        CHECK_AT("F of a row", i, entry(&b, b.gradient, i, 0, 0) == 1.0 && entry(&b, b.gradient, i, 0, 1) == 0.0 && entry(&b, b.gradient, i, 1, 1) == 1.0);
        CHECK_AT("force on a row", i, b.a[0][i] == SPH_R(0) && b.a[1][i] == SPH_R(0));
    }
    body_free(&b);
}
static void test_periodic(void)
{
    enum { SIDE = 8, N = SIDE * SIDE };
    body b = body_of(cloud_new(2, N), 1);
    const sph_points reference = sph_points_periodic(cloud_points(&b.c), SPH_R(1), SPH_R(1), SPH_R(0));
    const sph_points stretched = sph_points_periodic(current(&b), SPH_R(1.25), SPH_R(0.5), SPH_R(0));
    sph_correction_out o;
    sph_cloud all;
    sph_index i, j, pairs = 0;
    memset(&o, 0, sizeof o);
    o.inverse = sph_matrix_out_packed(2, b.inverse);
    b.c.h = SPH_R(1.6 / SIDE);
    b.c.index = (sph_index *)cloud_memory(N * (N - 1), sizeof *b.c.index);
    for (i = 0; i < N; i++) {
        b.c.x[i] = SPH_R(((int)i % SIDE + 0.3) / SIDE);
        b.c.y[i] = SPH_R(((int)i / SIDE + 0.1 * ((int)i % 3)) / SIDE);
        b.x[0][i] = SPH_R(1.25) * b.c.x[i];
        b.x[1][i] = SPH_R(0.5) * b.c.y[i];
        b.c.V[i] = SPH_R(1.0 / N);
        b.h[i] = b.c.h;
    }
    for (i = 0; i < N; i++) {
        for (j = 0; j < N; j++)
            if (j != i && (double)sph_length(2, sphi_separation(2, reference, sphi_point(2, reference, i), sphi_point(2, reference, j))) < 2.0 * (double)b.c.h) b.c.index[pairs++] = j;
        b.c.start[i + 1] = pairs;
    }
    all = sph_cloud_of(reference, cloud_list(&b.c), cloud_h(&b.c), cloud_V(&b.c));
    CHECK(sph_gradient_correction_cspm(KERNEL, 2, all, o) == 0);
    CHECK(sph_deformation_gradient(KERNEL, 2, all, stretched, packed(&b, b.inverse), sph_matrix_out_packed(2, b.gradient)) == 0);
    for (i = 0; i < N; i++) {
        CHECK_NEAR("F of a box that is stretched", i, entry(&b, b.gradient, i, 0, 0), 1.25, 200.0 * EPSILON);
        CHECK_NEAR("F of a box that is stretched", i, entry(&b, b.gradient, i, 1, 1), 0.5, 200.0 * EPSILON);
        CHECK_NEAR("F of a box that is stretched", i, entry(&b, b.gradient, i, 0, 1), 0.0, 200.0 * EPSILON);
    }
    { /* as many positions as in the cloud */
        sph_points fewer = stretched;
        fewer.n = N - 1;
        CHECK(sph_deformation_gradient(KERNEL, 2, all, fewer, packed(&b, b.inverse), sph_matrix_out_packed(2, b.gradient)) == SPH_ERROR_COUNT);
    }
    body_free(&b);
}

int main(void)
{
    test_affine();
    test_laws();
    test_conservation();
    test_divergence();
    test_hourglass();
    test_degenerate();
    test_periodic();
    return check_report("test_solids");
}
