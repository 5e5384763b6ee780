/* SPDX-License-Identifier: MIT
 *
 * solids.h - an elastic body in the plane, in total Lagrangian form, that the drivers of this folder share.
 *
 *     body b;
 *     body_open(&b, dx, 1.3 * dx, sph_elastic_of(1, 0.3), BODY_NEO_HOOKEAN);
 *     for (...) body_add(&b, x, y);                        its reference state
 *     body_start(&b);                                      lists and corrections, once
 *     ... b.v[0][i], b.held[i] ...
 *     for (...) body_step(&b, body_time_step(&b));
 *     body_close(&b);
 *
 * The density of the reference state is 1, and dx^2 the volume of a particle. A step is kick, drift, kick:
 * v += dt a / 2; x += dt v; F(x); P(F); a(P); v += dt a / 2. Particles that are held have v = 0. Whoever adds
 * forces between bodies sets b.push.
 */
#ifndef SOLIDS_H
#define SOLIDS_H

#include "../common/host.h"

#include "../common/figure.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/random.h"
#include "../common/report.h"

#include <math.h>

#define BODY_KERNEL SPH_WENDLAND_C2

typedef struct solids_options {
    const char *out, *figures;
    int full, quiet;
} solids_options;
/* clang-format off */
#define SOLIDS_OPTIONS(o) \
    {"out", "folder of the result table", OPTION_TEXT, &(o).out, 0, 0}, \
    {"figures", "folder of the figures' data", OPTION_TEXT, &(o).figures, 0, 0}, \
    {"full", "finer bodies, and longer runs", OPTION_FLAG, &(o).full, 0, 0}, \
    {"quiet", "no progress on the terminal", OPTION_FLAG, &(o).quiet, 0, 0}, THREADS_OPTION
/* clang-format on */
enum { SOLIDS_OPTION_COUNT = 5 };

typedef enum body_law { BODY_SAINT_VENANT_KIRCHHOFF, BODY_NEO_HOOKEAN } body_law;

typedef struct body {
    int n, room;
    double dx, h, hourglass, young; /* hourglass: its coefficient, 1 */
    sph_elastic elastic;
    body_law law;
    int plain; /* 1: the force is without L, as it is often written: to be seen to fail */
    double *X[2], *x[2], *v[2], *a[2], *volume, *density, *modulus;
    double *inverse, *gradient, *stress, *one; /* matrices */
    unsigned char *held;
    search near;
    sph_cloud cloud; /* of the reference state */
    void (*push)(struct body *); /* adds to a; null: nothing */
    void *others;                /* for push */
} body;

static inline void body_open(body *b, double dx, double h, sph_elastic elastic, body_law law)
{
    memset(b, 0, sizeof *b);
    b->dx = dx;
    b->h = h;
    b->elastic = elastic;
    b->law = law;
    b->hourglass = 1;
    b->young = elastic.shear * (3 * elastic.first + 2 * elastic.shear) / (elastic.first + elastic.shear);
}
static inline double *body_numbers(double *old, int count) { return (double *)need(old, (size_t)count, sizeof *old); }
static inline int body_add(body *b, double x, double y)
{
    if (b->n == b->room) {
        b->room = b->room ? 2 * b->room : 256;
        b->X[0] = body_numbers(b->X[0], b->room);
        b->X[1] = body_numbers(b->X[1], b->room);
    }
    b->X[0][b->n] = x;
    b->X[1][b->n] = y;
    return b->n++;
}
static inline void body_close(body *b)
{
    int k;
    for (k = 0; k < 2; k++) {
        free(b->X[k]);
        free(b->x[k]);
        free(b->v[k]);
        free(b->a[k]);
    }
    free(b->volume);
    free(b->density);
    free(b->modulus);
    free(b->inverse);
    free(b->gradient);
    free(b->stress);
    free(b->one);
    free(b->held);
    search_close(&b->near);
}

static inline sph_cloud body_targets(const body *b, long first, long last)
{
    return sph_cloud_range(b->cloud, (sph_index)first, (sph_index)last);
}
static inline sph_points body_points(const body *b) { return sph_points_separate(b->n, b->x[0], b->x[1], NULL); }
static inline long body_strain_part(void *data, long first, long last)
{
    const body *const b = (const body *)data;
    const sph_matrix_out F = sph_matrix_out_packed(2, b->gradient), P = sph_matrix_out_packed(2, b->stress);
    const sph_index answer = sph_deformation_gradient(BODY_KERNEL, 2, body_targets(b, first, last), body_points(b),
                                                      sph_matrices_packed(2, b->inverse), F);
    long i;
    if (answer) return answer;
    for (i = first; i < last; i++) { /* the law is the host's */
        const size_t at = 4 * (size_t)i;
        sph_mat f = {{F.x.x[at], F.x.y[at], 0}, {F.y.x[at], F.y.y[at], 0}, {0, 0, 0}}, p;
        if (b->law == BODY_NEO_HOOKEAN && !(f.x.x * f.y.y - f.x.y * f.y.x > 0)) return 1; /* inside out */
        p = b->law == BODY_NEO_HOOKEAN ? sph_stress_neo_hookean(2, f, b->elastic)
                                       : sph_stress_saint_venant_kirchhoff(2, f, b->elastic);
        P.x.x[at] = p.x.x;
        P.x.y[at] = p.x.y;
        P.y.x[at] = p.y.x;
        P.y.y[at] = p.y.y;
    }
    return 0;
}
static inline long body_force_part(void *data, long first, long last)
{
    const body *const b = (const body *)data;
    const sph_solid s = {.inverse = sph_matrices_packed(2, b->plain ? b->one : b->inverse),
                         .stress = sph_matrices_packed(2, b->stress),
                         .density = sph_scalars_array(b->density),
                         .hourglass = b->hourglass,
                         .x = body_points(b),
                         .gradient = sph_matrices_packed(2, b->gradient),
                         .modulus = sph_scalars_array(b->modulus)};
    return sph_solid_acceleration(BODY_KERNEL, 2, body_targets(b, first, last), s, vectors_into(b->a, 2));
}
static inline void body_forces(body *b)
{
    expect_all((sph_index)threads_each(b->n, body_strain_part, b));
    expect_all((sph_index)threads_each(b->n, body_force_part, b));
    if (b->push) b->push(b);
}

/* Lists, corrections, and the particles at rest where they were added. */
static inline void body_start(body *b)
{
    const double support = sph_kernel_support(BODY_KERNEL, b->h);
    const sph_points reference = sph_points_separate(b->n, b->X[0], b->X[1], NULL);
    sph_correction_out out = {.conditioning = NULL};
    int i, k;
    for (k = 0; k < 2; k++) {
        b->x[k] = body_numbers(NULL, b->n);
        memcpy(b->x[k], b->X[k], (size_t)b->n * sizeof(double));
        b->v[k] = (double *)need_zeros((size_t)b->n, sizeof(double));
        b->a[k] = (double *)need_zeros((size_t)b->n, sizeof(double));
    }
    b->volume = body_numbers(NULL, b->n);
    b->density = body_numbers(NULL, b->n);
    b->modulus = body_numbers(NULL, b->n);
    b->inverse = body_numbers(NULL, 4 * b->n);
    b->gradient = body_numbers(NULL, 4 * b->n);
    b->stress = body_numbers(NULL, 4 * b->n);
    b->one = (double *)need_zeros(4 * (size_t)b->n, sizeof(double));
    b->held = (unsigned char *)need_zeros((size_t)b->n, 1);
    for (i = 0; i < b->n; i++) {
        b->volume[i] = b->dx * b->dx;
        b->density[i] = 1;
        b->modulus[i] = b->young;
        b->one[4 * i] = b->one[4 * i + 3] = 1;
    }
    search_all(&b->near, 2, reference, sph_scalars_same(&support), SPH_GATHER);
    b->cloud = sph_cloud_checked(
        2, sph_cloud_of(reference, b->near.found.list, sph_scalars_same(&b->h), sph_scalars_array(b->volume)));
    out.inverse = sph_matrix_out_packed(2, b->inverse);
    expect_all(sph_gradient_correction_cspm(BODY_KERNEL, 2, b->cloud, out));
    body_forces(b);
}
static inline double body_time_step(const body *b)
{
    return 1.6 * sph_time_step_sound(b->h, sph_sound_speed_elastic(b->elastic, 1), 0);
}
static inline void body_kick(body *b, double dt)
{
    int i;
    for (i = 0; i < b->n; i++) {
        b->v[0][i] = b->held[i] ? 0 : b->v[0][i] + dt * b->a[0][i];
        b->v[1][i] = b->held[i] ? 0 : b->v[1][i] + dt * b->a[1][i];
    }
}
static inline void body_drift(body *b, double dt)
{
    int i;
    for (i = 0; i < b->n; i++) {
        b->x[0][i] += dt * b->v[0][i];
        b->x[1][i] += dt * b->v[1][i];
    }
}
static inline void body_step(body *b, double dt)
{
    body_kick(b, 0.5 * dt);
    body_drift(b, dt);
    body_forces(b);
    body_kick(b, 0.5 * dt);
}

/* ---------------------------------------------------------------- what is measured */

typedef struct body_totals {
    double momentum[2], angular, kinetic, torque, force; /* of all; force: the sum of |m a| */
} body_totals;
static inline body_totals body_sums(const body *b)
{
    body_totals t = {{0, 0}, 0, 0, 0, 0};
    int i;
    for (i = 0; i < b->n; i++) {
        const double m = b->volume[i] * b->density[i], vx = b->v[0][i], vy = b->v[1][i];
        t.momentum[0] += m * vx;
        t.momentum[1] += m * vy;
        t.angular += m * (b->x[0][i] * vy - b->x[1][i] * vx);
        t.kinetic += 0.5 * m * (vx * vx + vy * vy);
        t.torque += m * (b->x[0][i] * b->a[1][i] - b->x[1][i] * b->a[0][i]);
        t.force += m * hypot(b->a[0][i], b->a[1][i]);
    }
    return t;
}
/* Kinetic energy, that of Saint Venant & Kirchhoff, and that of the hourglass control. */
static inline double body_energy(const body *b)
{
    double sum = body_sums(b).kinetic;
    int i, r, c, k;
    sph_index p;
    for (i = 0; i < b->n; i++) {
        const double *const F = b->gradient + 4 * i;
        double trace = 0, square = 0;
        for (r = 0; r < 2; r++)
            for (c = 0; c < 2; c++) {
                double e = r == c ? -0.5 : 0;
                for (k = 0; k < 2; k++) e += 0.5 * F[2 * k + r] * F[2 * k + c];
                trace += r == c ? e : 0;
                square += e * e;
            }
        sum += b->volume[i] * (0.5 * b->elastic.first * trace * trace + b->elastic.shear * square);
        for (p = b->cloud.list.start[i]; p < b->cloud.list.start[i + 1]; p++) {
            const sph_index j = b->cloud.list.index[p];
            const double X = b->X[0][i] - b->X[0][j], Y = b->X[1][i] - b->X[1][j];
            const double ex = F[0] * X + F[1] * Y - b->x[0][i] + b->x[0][j],
                         ey = F[2] * X + F[3] * Y - b->x[1][i] + b->x[1][j];
            sum -= 0.25 * b->hourglass * b->young * b->volume[i] * b->volume[j] *
                   sph_kernel_f(BODY_KERNEL, 2, hypot(X, Y), b->h) * (ex * ex + ey * ey);
        }
    }
    return sum;
}
/* Von Mises' measure of the Cauchy stress P F^T / J, in plane strain with the stress across left out. */
static inline double body_mises(const body *b, int i)
{
    const double *const F = b->gradient + 4 * i, *const P = b->stress + 4 * i;
    const double J = F[0] * F[3] - F[1] * F[2], xx = (P[0] * F[0] + P[1] * F[1]) / J,
                 yy = (P[2] * F[2] + P[3] * F[3]) / J, xy = (P[0] * F[2] + P[1] * F[3]) / J;
    return sqrt(xx * xx - xx * yy + yy * yy + 3 * xy * xy);
}
static inline void body_write(const body *b, const char *dir, const char *name)
{
    FILE *const out = figure_open(dir, name);
    int i;
    fputs("x,y,vx,vy,mises\n", out);
    for (i = 0; i < b->n; i++)
        fprintf(out, "%.5g,%.5g,%.4g,%.4g,%.4g\n", b->x[0][i], b->x[1][i], b->v[0][i], b->v[1][i], body_mises(b, i));
    figure_close(out);
}

#endif
