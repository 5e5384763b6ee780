/* SPDX-License-Identifier: MIT */
/*
 * test_contract.c - tests/CONTRACT.md, cell by cell: what every function of the three headers that takes arrays answers to every kind of bad or degenerate input.
 *
 * The tables are read when the test runs (from the repository's root), and so are the headers: a function without a row, a row without a function, a cell without a fault
 * behind it and a fault without a cell all fail. All arrays of a call lie in one piece of memory with guards in between; the whole of it is compared after each call.
 * Each call that is refused must say so once (SPH_REFUSED), with the error, the argument and the first
 * particle at fault. Each is made twice, the second time with a cloud that sph_cloud_checked has marked: same
 * answer, same bytes. Those that are good are made once more, with outputs that are members of structs.
 * Last, of each input it is found out by trial whether sources that are no targets have a part in an answer: if so, a NaN
 * of theirs is refused; if not, it changes nothing.
 *
 * A new function needs a row in the tables, a line in `functions` and one to call it; a new fault a column and an entry in `columns`.
 * tests/test_contract_unchecked.c is the same with SPH_CHECK = 0, without the columns under "Contents".
 */
#if defined(__unix__) || defined(__APPLE__)
#define _POSIX_C_SOURCE 200809L /* alarm */
#endif
/* what no input may bring a sweep to: to ask a pair function for what it cannot answer (but for overlaps) */
static const char *asserted;
#define SPH_ASSERT(x) ((x) ? (void)0 : (void)(asserted = #x))
#include "one_copy.h"
#include "refusal.h"
#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <float.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#define WATCH(seconds) alarm(seconds)
#else
#define WATCH(seconds) ((void)0)
#endif
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1 /* as gcc says it */
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(at, size) ((void)0)
#define ASAN_UNPOISON_MEMORY_REGION(at, size) ((void)0)
#endif

/* ---------------------------------------------------------------- what a call is made of */

/* Every array: name, what it holds, the axis it belongs to (it is there for dim > axis), how many. The inputs first. */
enum { REAL, INDEX_, BYTE, BYTES };              /* BYTES: anything else, by its size */
enum { EACH, PAIR, ROWS, ROOM, WORK_ROOM, FEW }; /* as many as particles, pairs, particles and one; for the longest list, a workspace, a struct */
/* clang-format off */
#define ARRAYS_OF(X) \
    X(PX, REAL, 0, EACH) X(PY, REAL, 1, EACH) X(PZ, REAL, 2, EACH) \
    X(QX, REAL, 0, EACH) X(QY, REAL, 1, EACH) X(QZ, REAL, 2, EACH) /* other positions: targets that are no sources, positions of before */ \
    X(H, REAL, 0, EACH) X(REACH, REAL, 0, EACH) X(GUESS, REAL, 0, EACH) X(V, REAL, 0, EACH) X(M, REAL, 0, EACH) X(RHO, REAL, 0, EACH) X(OMEGA, REAL, 0, EACH) \
    X(INVERSE_M, REAL, 0, EACH) X(MX, REAL, 0, EACH) X(MY, REAL, 1, EACH) X(MZ, REAL, 2, EACH) /* mobilities */ \
    X(F, REAL, 0, EACH) X(U, REAL, 0, EACH) X(P, REAL, 0, EACH) X(C, REAL, 0, EACH) X(ALPHA, REAL, 0, EACH) X(ALPHA_B, REAL, 0, EACH) \
    X(VX, REAL, 0, EACH) X(VY, REAL, 1, EACH) X(VZ, REAL, 2, EACH) X(BX, REAL, 0, EACH) X(BY, REAL, 1, EACH) X(BZ, REAL, 2, EACH) \
    X(ROW, REAL, 0, PAIR) X(DIAGONAL, REAL, 0, EACH) X(START, INDEX_, 0, ROWS) X(INDEX, INDEX_, 0, ROOM) X(ORDER, INDEX_, 0, EACH) X(COUNT, INDEX_, 0, EACH) \
    X(GRID, BYTES, 0, FEW) X(WORK, BYTES, 0, WORK_ROOM) \
    X(O0, REAL, 0, EACH) X(O1, REAL, 1, EACH) X(O2, REAL, 2, EACH) X(O3, REAL, 0, EACH) X(O4, REAL, 1, EACH) X(O5, REAL, 2, EACH) /* vectors */ \
    X(HXX, REAL, 0, EACH) X(HXY, REAL, 1, EACH) X(HYY, REAL, 1, EACH) X(HXZ, REAL, 2, EACH) X(HYZ, REAL, 2, EACH) X(HZZ, REAL, 2, EACH) \
    X(S0, REAL, 0, EACH) X(S1, REAL, 0, EACH) X(S2, REAL, 0, EACH) X(S3, REAL, 0, EACH) X(S4, REAL, 0, EACH) X(S5, REAL, 0, EACH) X(S6, REAL, 0, EACH) X(S7, REAL, 0, EACH) \
    X(R0, REAL, 0, ROOM) X(R1, REAL, 1, ROOM) X(R2, REAL, 2, ROOM) /* rows */ \
    X(I0, INDEX_, 0, ROWS) X(I1, INDEX_, 0, ROOM) X(REPORT, BYTES, 0, FEW) X(STATUS, BYTE, 0, EACH)
/* clang-format on */
#define ARRAY_NAME(name, holds, axis, room) name,
enum array { ARRAYS_OF(ARRAY_NAME) ARRAYS, FIRST_OUTPUT = O0 };
static const struct {
    const char *name;
    int holds, axis, room;
} arrays[ARRAYS] = {
#define ARRAY_ENTRY(name, holds, axis, room) {#name, holds, axis, room},
    ARRAYS_OF(ARRAY_ENTRY)};
#define BIT(a) ((uint64_t)1 << (a))
#define XYZ(x) ((uint64_t)7 << (x))
#define HESSIAN (BIT(HXX) | BIT(HXY) | BIT(HYY) | BIT(HXZ) | BIT(HYZ) | BIT(HZZ))
#define POSITIONS (XYZ(PX) | XYZ(QX))

/* Every number: name, what is out of its range, a good value. Lengths have an error of their own (H). */
enum { ANY_NUMBER, NOT_NEGATIVE, POSITIVE, BELOW_ONE, OF_FLAGS, NO_LESS_THAN_0, ONE_OF };
enum { VALUE_, LENGTH };
/* clang-format off */
#define NUMBERS_OF(X) \
    X(LEAST, NOT_NEGATIVE, 0.0, VALUE_) X(CONDITIONING, ANY_NUMBER, 0.0, VALUE_) X(OPERATOR, ANY_NUMBER, 1.0, VALUE_) X(ETA, NOT_NEGATIVE, 1.0, VALUE_) \
    X(TOLERANCE, BELOW_ONE, 1e-3, VALUE_) X(RESTITUTION, NOT_NEGATIVE, 0.9, VALUE_) X(DENSITY, POSITIVE, 20.0, VALUE_) \
    X(GRAVITY, ANY_NUMBER, 1.0, VALUE_) X(CH, NOT_NEGATIVE, 1.0, VALUE_) X(SIGMA, NOT_NEGATIVE, 0.3, VALUE_) X(PARAMETER_A, ANY_NUMBER, 1.0, VALUE_) \
    X(PARAMETER_B, ANY_NUMBER, 0.5, VALUE_) X(PARAMETER_C, ANY_NUMBER, 0.1, VALUE_) X(TAU, ANY_NUMBER, 0.1, VALUE_) \
    X(WAVE, ANY_NUMBER, 1.0, VALUE_) X(SKIN, NOT_NEGATIVE, 0.1, VALUE_) X(RATIO, POSITIVE, 0.8, VALUE_) X(GRADIENT, ONE_OF + 3, 0.0, VALUE_) X(MEAN, ONE_OF + 2, 0.0, VALUE_) \
    X(VISCOSITY, ONE_OF + 3, 1.0, VALUE_) X(CRITERION, ONE_OF + 3, 2.0, VALUE_) X(FLAGS, OF_FLAGS, 0.0, VALUE_) X(CAPACITY, NO_LESS_THAN_0, 0.0, VALUE_) \
    X(DISTANCE, POSITIVE, 0.0, LENGTH) X(WITHIN, NOT_NEGATIVE, 0.0, LENGTH) X(STEP, ANY_NUMBER, 0.1, LENGTH)
/* clang-format on */
#define NUMBER_NAME(name, range, good, kind) name,
enum number { NUMBERS_OF(NUMBER_NAME) NUMBERS };
static const struct {
    const char *name;
    int range, kind;
    double good;
} numbers[NUMBERS] = {
#define NUMBER_ENTRY(name, range, good, kind) {#name, range, kind, good},
    NUMBERS_OF(NUMBER_ENTRY)};
#define N(number) ((uint32_t)1 << (number))

typedef struct world {
    void *a[ARRAYS];
    double number[NUMBERS];
    int k, dim, bins, left, right;
    sph_index first, last, n, m; /* n: sources, m: of the other positions */
    size_t stride, other_stride, array_stride, out_stride, work_size, block_size;
    double box[3];
    uint64_t same; /* one value for all */
    int marked;    /* 1: the cloud is checked before the call */
} world;

static sph_real *real_of(const world *w, int a) { return (sph_real *)w->a[a]; }
static sph_index *index_of(const world *w, int a) { return (sph_index *)w->a[a]; }
static sph_scalars scalars_of(const world *w, int a) { return sph_scalars_strided(real_of(w, a), w->same & BIT(a) ? 0 : 1); }
static sph_vectors vectors_of(const world *w, int a)
{
    sph_vectors v;
    v.x = scalars_of(w, a);
    v.y = scalars_of(w, a + 1);
    v.z = w->dim > 2 ? scalars_of(w, a + 2) : sph_scalars_array(0); /* a third component in 2D is there if its array is */
    return v;
}
static sph_vector_out vector_out_of(const world *w, int a)
{
    return sph_vector_out_strided(real_of(w, a), real_of(w, a + 1), real_of(w, a + 2), w->out_stride);
}
static sph_diagonal diagonal_of(const world *w, int a)
{
    sph_diagonal d;
    d.x = scalars_of(w, a);
    d.y = scalars_of(w, a + 1);
    d.z = scalars_of(w, a + 2);
    return d;
}
static sph_points points_of(const world *w)
{
    return sph_points_periodic(sph_points_strided(w->n, real_of(w, PX), real_of(w, PY), real_of(w, PZ), w->stride), SPH_R(w->box[0]), SPH_R(w->box[1]),
                               SPH_R(w->box[2]));
}
static sph_points others_of(const world *w) { return sph_points_strided(w->m, real_of(w, QX), real_of(w, QY), real_of(w, QZ), w->other_stride); }
static sph_part whole_part(void) /* of which everything is near */
{
    sph_part p;
    p.low.x = p.low.y = p.low.z = p.reach_low.x = p.reach_low.y = p.reach_low.z = SPH_R(-9);
    p.high.x = p.high.y = p.high.z = p.reach_high.x = p.reach_high.y = p.reach_high.z = SPH_R(9);
    return p;
}
static sph_points current_of(const world *w) /* of a solid: with its box */
{
    return sph_points_periodic(others_of(w), SPH_R(w->box[0]), SPH_R(w->box[1]), SPH_R(w->box[2]));
}
static sph_list list_of(const world *w)
{
    sph_list l;
    l.start = index_of(w, START);
    l.index = index_of(w, INDEX);
    return l;
}
static sph_medium gas_of(const world *w)
{
    sph_medium g;
    g.m = scalars_of(w, M);
    g.rho = scalars_of(w, RHO);
    g.omega = scalars_of(w, OMEGA);
    return g;
}
static sph_cloud cloud_of(const world *w)
{
    const sph_cloud all = sph_cloud_of(points_of(w), list_of(w), scalars_of(w, H), scalars_of(w, V));
    const sph_cloud c = sph_cloud_range(all, w->first, w->last);
    return w->marked ? sph_cloud_checked(w->dim, c) : c;
}
static sph_cloud last_of(const world *w) /* its last target alone, if it has one */
{
    const sph_index i = w->first < 0 || w->first == w->last ? w->first : w->last - 1;
    return sph_cloud_range(cloud_of(w), i, w->first == w->last ? i : i + 1);
}
static sph_cloud others_with_list(const world *w)
{
    const sph_scalars none = sph_scalars_none();
    return sph_cloud_range(sph_cloud_of(others_of(w), list_of(w), none, none), w->first, w->last);
}
static sph_cloud foreign_of(const world *w)
{
    sph_cloud c = others_with_list(w);
    c.h = scalars_of(w, H);
    return c;
}
static sph_sources sources_of(const world *w)
{
    sph_sources s;
    s.points = points_of(w);
    s.volume = scalars_of(w, V);
    return s;
}
static sph_interpolation_options interpolation_options_of(const world *w)
{
    sph_interpolation_options o;
    o.conditioning_min = SPH_R(w->number[LEAST]);
    return o;
}
static sph_interpolation_out interpolation_of(const world *w)
{
    sph_interpolation_out o;
    o.value = real_of(w, S0);
    o.gx = real_of(w, O0);
    o.gy = real_of(w, O1);
    o.gz = real_of(w, O2);
    o.conditioning = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_interpolation_rows_out interpolation_rows_of(const world *w)
{
    sph_interpolation_rows_out o = {0};
    o.x = real_of(w, R0);
    o.y = real_of(w, R1);
    o.z = real_of(w, R2);
    o.conditioning = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_shear_bulk shear_bulk_of(const world *w)
{
    sph_shear_bulk mu;
    mu.shear = scalars_of(w, MX);
    mu.bulk = scalars_of(w, C);
    return mu;
}
static sph_fluid fluid_of(const world *w)
{
    sph_fluid f;
    f.m = scalars_of(w, M);
    f.rho = scalars_of(w, RHO);
    f.p = scalars_of(w, P);
    f.c = scalars_of(w, C);
    f.v = vectors_of(w, VX);
    f.viscosity = (int)w->number[VISCOSITY];
    f.alpha = SPH_R(w->number[PARAMETER_A]);
    f.beta = SPH_R(w->number[PARAMETER_B]);
    f.eta = SPH_R(w->number[PARAMETER_C]);
    return f;
}
static sph_riemann_options riemann_options_of(const world *w)
{
    sph_riemann_options o = {0};
    o.limiter = SPH_R(w->number[PARAMETER_A]);
    o.gravity.x = SPH_R(w->number[GRAVITY]);
    return o;
}
static sph_tension tension_of(const world *w)
{
    sph_tension t;
    t.rho = scalars_of(w, RHO);
    t.normal = vectors_of(w, BX);
    t.sigma = SPH_R(w->number[PARAMETER_A]);
    t.least = SPH_R(w->number[CONDITIONING]);
    return t;
}
static sph_tension_out tension_out_of(const world *w)
{
    sph_tension_out o = {0};
    o.acceleration = vector_out_of(w, O0);
    o.curvature = real_of(w, S0);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
/* elements between any points: gamma of them means nothing, but is finite */
static sph_wall_elements elements_of(const world *w)
{
    sph_wall_elements e;
    memset(&e, 0, sizeof e);
    e.n = w->n;
    e.a = vectors_of(w, BX);
    e.b = vectors_of(w, VX);
    e.c = e.a; /* the corners a with their axes exchanged; 3D reads them */
    if (w->dim > 2) e.c.x = e.a.z, e.c.y = e.a.x, e.c.z = e.a.y;
    return e;
}
static sph_wall_gamma_out gamma_out_of(const world *w)
{
    sph_wall_gamma_out o = {0};
    o.gamma = real_of(w, S0);
    o.gradient = vector_out_of(w, O0);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_wall_terms wall_terms_of(const world *w)
{
    sph_wall_terms t;
    t.gamma = scalars_of(w, RHO);
    t.gradient = vectors_of(w, BX);
    t.value = scalars_of(w, U);
    t.slope = vectors_of(w, VX);
    return t;
}
static sph_derivatives_out derivative_out_of(const world *w)
{
    sph_derivatives_out o;
    o.gx = real_of(w, O0);
    o.gy = real_of(w, O1);
    o.gz = real_of(w, O2);
    o.hxx = real_of(w, HXX);
    o.hxy = real_of(w, HXY);
    o.hyy = real_of(w, HYY);
    o.hxz = real_of(w, HXZ);
    o.hyz = real_of(w, HYZ);
    o.hzz = real_of(w, HZZ);
    o.laplacian = real_of(w, S0);
    o.conditioning = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
/* The rows of matrices. diagonal: the mobilities of the axes on the diagonal, and others beside it; else each row the vector at a. */
static sph_matrices matrices_of(const world *w, int a, int diagonal)
{
    sph_matrices m;
    m.x = m.y = m.z = vectors_of(w, a);
    if (diagonal) {
        m.x.x = scalars_of(w, MX);
        m.y.y = scalars_of(w, MY);
        m.z.z = scalars_of(w, MZ);
        m.x.y = m.y.x = scalars_of(w, BY);
        m.x.z = m.z.x = m.y.z = m.z.y = scalars_of(w, BZ);
    }
    return m;
}
#define MATRIX_OUT (XYZ(O0) | BIT(HXY) | BIT(HYY) | BIT(O5) | BIT(HXZ) | BIT(HYZ) | BIT(HZZ)) /* there with their rows and columns */
static sph_matrix_out matrix_out_of(const world *w)
{
    sph_matrix_out o;
    o.x = vector_out_of(w, O0);
    o.y = sph_vector_out_strided(real_of(w, HXY), real_of(w, HYY), real_of(w, O5), w->out_stride);
    o.z = sph_vector_out_strided(real_of(w, HXZ), real_of(w, HYZ), real_of(w, HZZ), w->out_stride);
    return o;
}
static sph_correction_out correction_out_of(const world *w)
{
    sph_correction_out o = {0};
    o.inverse = matrix_out_of(w);
    o.conditioning = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_rk rk_of(const world *w)
{
    sph_rk r;
    r.scale = scalars_of(w, U);
    r.slope = r.scale_gradient = vectors_of(w, BX);
    r.slope_gradient = matrices_of(w, BX, 0);
    return r;
}
static sph_corrected_out corrected_out_of(const world *w)
{
    sph_corrected_out o = {0};
    o.acceleration = vector_out_of(w, O0);
    o.rate_u = real_of(w, S0);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_rk_out rk_out_of(const world *w)
{
    sph_rk_out o = {0};
    o.scale = real_of(w, S0);
    o.conditioning = real_of(w, S1);
    o.stride = w->out_stride;
    o.slope = vector_out_of(w, O0);
    o.scale_gradient = vector_out_of(w, O3);
    o.slope_gradient = sph_matrix_out_packed(w->dim, real_of(w, R0)); /* R0 has room for all of them */
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_solid solid_of(const world *w)
{
    sph_solid s = {0};
    s.inverse = s.gradient = matrices_of(w, BX, 0);
    s.stress = matrices_of(w, VX, 0);
    s.density = scalars_of(w, RHO);
    s.hourglass = SPH_R(w->number[PARAMETER_A]);
    s.x = current_of(w);
    s.modulus = scalars_of(w, C);
    return s;
}
static sph_scalar_out scalar_out_of(const world *w)
{
    return sph_scalar_out_strided(real_of(w, S0), w->out_stride, (unsigned char *)w->a[STATUS]);
}
static sph_rows_out row_out_of(const world *w)
{
    sph_rows_out o = {0};
    o.row = real_of(w, R0);
    o.diagonal = real_of(w, S0);
    o.factor = real_of(w, S2);
    o.conditioning = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_gradient_rows_out gradient_row_out_of(const world *w)
{
    sph_gradient_rows_out o = {0};
    o.x = real_of(w, R0);
    o.y = real_of(w, R1);
    o.z = real_of(w, R2);
    o.conditioning = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_jet jet_of(const world *w)
{
    sph_jet d = sph_jet_laplacian(3);
    d.hessian.xx = SPH_R(w->number[OPERATOR]);
    return d;
}
static sph_elliptic_options options_of(const world *w)
{
    sph_elliptic_options o = {0};
    o.gradient = (int)w->number[GRADIENT];
    o.mean = (int)w->number[MEAN];
    o.conditioning_min = SPH_R(w->number[CONDITIONING]);
    return o;
}
static sph_elliptic_options options_with_source(const world *w)
{
    sph_elliptic_options o = options_of(w);
    o.source = scalars_of(w, U);
    return o;
}
static sph_boundary boundary_of(const world *w)
{
    sph_boundary b;
    b.normal = vectors_of(w, BX);
    b.alpha = scalars_of(w, F);
    b.beta = scalars_of(w, U);
    return b;
}
static sph_csr csr_of(const world *w)
{
    sph_csr m;
    m.start = index_of(w, I0);
    m.column = index_of(w, I1);
    m.value = real_of(w, R0);
    m.capacity = (int64_t)w->number[CAPACITY];
    return m;
}
static sph_collision collision_of(const world *w)
{
    sph_collision c;
    c.distance = SPH_R(w->number[DISTANCE]);
    c.restitution = SPH_R(w->number[RESTITUTION]);
    c.inverse_mass = scalars_of(w, INVERSE_M);
    return c;
}
static sph_cleaning cleaning_of(const world *w)
{
    sph_cleaning c;
    c.medium = gas_of(w);
    c.field = vectors_of(w, BX);
    c.psi = scalars_of(w, F);
    c.div_v = scalars_of(w, U);
    c.ch = SPH_R(w->number[CH]);
    c.sigma = SPH_R(w->number[SIGMA]);
    return c;
}
static sph_cleaning_out cleaning_out_of(const world *w)
{
    sph_cleaning_out o = {0};
    o.rate_B = vector_out_of(w, O0);
    o.rate_psi = real_of(w, S0);
    o.div_B = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_scalar_out potential_of(const world *w)
{
    return sph_scalar_out_strided(real_of(w, S0), w->out_stride, 0);
}
static sph_derivatives_options derivatives_options_of(const world *w)
{
    sph_derivatives_options o = {0};
    o.conditioning_min = SPH_R(w->number[LEAST]);
    return o;
}
static sph_fluid_out fluid_out_of(const world *w)
{
    sph_fluid_out o = {0};
    o.acceleration = vector_out_of(w, O0);
    o.rate = real_of(w, S0);
    o.heating = real_of(w, S1);
    o.stride = w->out_stride;
    o.status = (unsigned char *)w->a[STATUS];
    return o;
}
static sph_vec along_x(double x)
{
    sph_vec v;
    v.x = SPH_R(x);
    v.y = v.z = SPH_R(0);
    return v;
}
static sph_fluid still_of(const world *w) /* without velocities it is a fluid, too */
{
    sph_fluid f = fluid_of(w);
    f.p = f.c = sph_scalars_none();
    return f;
}
static sph_diffusion diffusion_of(const world *w, double rho0, double c)
{
    sph_diffusion d = {0};
    d.fluid = still_of(w);
    d.delta = SPH_R(w->number[PARAMETER_A]);
    d.tait.rho0 = SPH_R(rho0);
    d.tait.c = SPH_R(c);
    d.share = scalars_of(w, U);
    d.gradient = vectors_of(w, BX);
    d.gravity = along_x(w->number[GRAVITY]);
    return d;
}
static sph_shift shift_of(const world *w)
{
    sph_shift s = {0};
    s.strength = scalars_of(w, U);
    s.tensile = SPH_R(w->number[PARAMETER_A]);
    s.spacing = SPH_R(w->number[RATIO]);
    s.eigenvalue = scalars_of(w, F);
    s.normal = vectors_of(w, BX);
    s.longest = SPH_R(w->number[PARAMETER_B]);
    return s;
}
static sph_query query_of(const world *w)
{
    return sph_query_of(points_of(w), (int)w->number[CRITERION], scalars_of(w, REACH), (int)w->number[FLAGS]);
}

/* ---------------------------------------------------------------- the functions, all called through the same arguments */

/* clang-format off */
#define RANGE (sph_kernel)w->k, w->dim, cloud_of(w)
#define RANGE_ONE (sph_kernel)w->k, cloud_of(w) /* where the dimension is known */
#define LIST w->dim, cloud_of(w)
#define A(a) scalars_of(w, a)
#define R(a) real_of(w, a)
#define I(a) index_of(w, a)
#define X(number_) SPH_R(w->number[number_])
#define STATE (unsigned char *)w->a[STATUS]
#define CALL(name, ...) static sph_index call_##name(const world *w) { return (sph_index)sph_##name(__VA_ARGS__); }

CALL(shepard_sum, RANGE, scalar_out_of(w))
CALL(interpolate_shepard, RANGE, A(F), scalar_out_of(w))
CALL(density_summation, RANGE, A(M), scalar_out_of(w))
CALL(gradient_difference, RANGE, A(F), vector_out_of(w, O0))
CALL(gradient_cspm, RANGE, A(F), derivative_out_of(w))
CALL(gradient_rows_cspm, RANGE, gradient_row_out_of(w))
CALL(gradient_iad, RANGE, A(F), derivative_out_of(w))
CALL(gradient_rows_iad, RANGE, gradient_row_out_of(w))
CALL(gradient_correction_cspm, RANGE, correction_out_of(w))
CALL(gradient_correction_iad, RANGE, correction_out_of(w))
CALL(rk_correction, RANGE, rk_out_of(w))
CALL(interpolate_rk, RANGE, rk_of(w), A(F), scalar_out_of(w))
CALL(interpolate_rows_rk, RANGE, rk_of(w), row_out_of(w))
CALL(gradient_rk, RANGE, rk_of(w), A(F), vector_out_of(w, O0))
CALL(gradient_rows_rk, RANGE, rk_of(w), gradient_row_out_of(w))
CALL(gas_rates_crk, RANGE, fluid_of(w), rk_of(w), corrected_out_of(w))
CALL(gas_rates_iad, RANGE, fluid_of(w), matrices_of(w, BX, 0), corrected_out_of(w))
CALL(deformation_gradient, RANGE, current_of(w), matrices_of(w, BX, 0), matrix_out_of(w))
CALL(solid_acceleration, RANGE, solid_of(w), vector_out_of(w, O0))
CALL(laplacian_brookshaw, RANGE, A(F), scalar_out_of(w))
CALL(laplacian_rows_brookshaw, RANGE, row_out_of(w))
CALL(derivatives_cspm, RANGE, A(F), derivatives_options_of(w), derivative_out_of(w))
CALL(derivatives_icspm, RANGE, A(F), derivatives_options_of(w), derivative_out_of(w))
CALL(derivatives_fatehi_manzari, RANGE, A(F), derivatives_options_of(w), derivative_out_of(w))
CALL(derivatives_wls, RANGE, A(F), derivatives_options_of(w), derivative_out_of(w))
CALL(derivatives_rows_cspm, RANGE, jet_of(w), row_out_of(w))
CALL(derivatives_rows_icspm, RANGE, jet_of(w), row_out_of(w))
CALL(derivatives_rows_fatehi_manzari, RANGE, jet_of(w), row_out_of(w))
CALL(derivatives_rows_wls, RANGE, jet_of(w), row_out_of(w))
CALL(interpolate_mls, (sph_kernel)w->k, w->dim, foreign_of(w), sources_of(w), A(F), interpolation_options_of(w), interpolation_of(w))
CALL(interpolate_liu, (sph_kernel)w->k, w->dim, foreign_of(w), sources_of(w), A(F), interpolation_options_of(w), interpolation_of(w))
CALL(interpolate_rows_mls, (sph_kernel)w->k, w->dim, foreign_of(w), sources_of(w), interpolation_options_of(w), interpolation_rows_of(w))
CALL(interpolate_rows_liu, (sph_kernel)w->k, w->dim, foreign_of(w), sources_of(w), interpolation_options_of(w), interpolation_rows_of(w))
CALL(second_derivative_bim, RANGE_ONE, A(F), w->left, w->right, scalar_out_of(w))
CALL(second_derivative_rows_bim, RANGE_ONE, w->left, w->right, row_out_of(w))
CALL(elliptic_brookshaw, RANGE, A(MX), options_with_source(w), A(F), scalar_out_of(w))
CALL(elliptic_brookshaw_corrected, RANGE, A(MX), options_with_source(w), A(F), scalar_out_of(w))
CALL(elliptic_schwaiger, RANGE, A(MX), options_with_source(w), A(F), scalar_out_of(w))
CALL(elliptic_msph, RANGE, A(MX), options_with_source(w), A(F), scalar_out_of(w))
CALL(elliptic_basic_degiuli_ban, RANGE, A(MX), options_with_source(w), A(F), scalar_out_of(w))
CALL(elliptic_rows_brookshaw, RANGE, A(MX), options_of(w), row_out_of(w))
CALL(elliptic_rows_brookshaw_corrected, RANGE, A(MX), options_of(w), row_out_of(w))
CALL(elliptic_rows_schwaiger, RANGE, A(MX), options_of(w), row_out_of(w))
CALL(elliptic_rows_msph, RANGE, A(MX), options_of(w), row_out_of(w))
CALL(elliptic_rows_basic_degiuli_ban, RANGE, A(MX), options_of(w), row_out_of(w))
CALL(elliptic_rows_anisotropic, RANGE, diagonal_of(w, MX), row_out_of(w))
CALL(elliptic_tensor, RANGE, matrices_of(w, BX, 1), A(F), scalar_out_of(w))
CALL(elliptic_rows_tensor, RANGE, matrices_of(w, BX, 1), row_out_of(w))
CALL(elliptic_rows_boundary, RANGE, A(MX), options_of(w), boundary_of(w), row_out_of(w))
CALL(rows_apply, cloud_of(w), R(ROW), A(DIAGONAL), A(F), scalar_out_of(w))
CALL(rows_monotone, cloud_of(w), R(ROW), A(DIAGONAL), STATE)
CALL(rows_time_step, cloud_of(w), R(ROW), R(S0))
CALL(rows_growth, w->dim, last_of(w), R(ROW), X(TAU), along_x(w->number[WAVE]), R(S0), R(S1))
CALL(csr_size, cloud_of(w))
CALL(csr_assemble, cloud_of(w), R(ROW), A(DIAGONAL), 0, csr_of(w), (int64_t *)w->a[REPORT])
CALL(fluid_rates_monaghan, RANGE, fluid_of(w), fluid_out_of(w))
CALL(fluid_rates_colagrossi, RANGE, fluid_of(w), fluid_out_of(w))
CALL(fluid_rates_hu_adams, RANGE, fluid_of(w), fluid_out_of(w))
CALL(fluid_rates_riemann, RANGE, fluid_of(w), riemann_options_of(w), fluid_out_of(w))
CALL(density_number, RANGE, A(M), scalar_out_of(w))
CALL(viscosity_mu_morris, RANGE, fluid_of(w), A(MX), vector_out_of(w, O0))
CALL(viscosity_mu_monaghan_cleary, RANGE, fluid_of(w), A(MX), vector_out_of(w, O0))
CALL(viscosity_mu_espanol_revenga, RANGE, fluid_of(w), shear_bulk_of(w), vector_out_of(w, O0))
CALL(velocity_xsph, RANGE, fluid_of(w), X(PARAMETER_C), vector_out_of(w, O0))
CALL(density_diffusion_molteni, RANGE, diffusion_of(w, 0.0, w->number[CH]), scalar_out_of(w))
CALL(density_diffusion_antuono, RANGE, diffusion_of(w, 0.0, w->number[CH]), scalar_out_of(w))
CALL(density_diffusion_fourtakas, RANGE, diffusion_of(w, w->number[RATIO], w->number[DENSITY]), scalar_out_of(w))
CALL(density_diffusion_rows_molteni, RANGE, diffusion_of(w, 0.0, w->number[CH]), row_out_of(w))
CALL(free_surface_cone, LIST, A(F), vectors_of(w, BX), STATE)
CALL(shift_displacement, RANGE, shift_of(w), vector_out_of(w, O0))
CALL(tension_css, RANGE, tension_of(w), vector_out_of(w, O0))
CALL(tension_csf, RANGE, tension_of(w), tension_out_of(w))
CALL(wall_gamma, RANGE, elements_of(w), gamma_out_of(w))
CALL(wall_gradient, RANGE, wall_terms_of(w), A(F), vector_out_of(w, O0))
CALL(wall_laplacian, RANGE, wall_terms_of(w), A(F), scalar_out_of(w))
CALL(wall_gradient_rows, RANGE, wall_terms_of(w), gradient_row_out_of(w), vector_out_of(w, O0))
CALL(wall_laplacian_rows, RANGE, wall_terms_of(w), row_out_of(w), sph_scalar_out_strided(R(S3), w->out_stride, 0))
CALL(pressure_factor_dfsph, RANGE, still_of(w), A(U), scalar_out_of(w))
CALL(collision_count, LIST, collision_of(w), vectors_of(w, VX), I(I0))
CALL(collision_change_weighted, LIST, collision_of(w), vectors_of(w, VX), I(COUNT), vector_out_of(w, O0))
CALL(nearest_distance, w->dim, others_with_list(w), points_of(w), scalar_out_of(w))
CALL(hexatic_order, cloud_of(w), scalar_out_of(w))
CALL(radial_distribution, LIST, X(DISTANCE), X(DENSITY), w->bins, R(S0))
CALL(coincident_count, LIST, X(WITHIN))
CALL(coincident_separate, LIST, X(WITHIN), X(STEP), vector_out_of(w, O0))
CALL(conserved_sums, LIST, A(M), vectors_of(w, VX), (sph_conserved *)w->a[S0])
CALL(divergence_difference, RANGE, gas_of(w), vectors_of(w, BX), scalar_out_of(w))
CALL(divergence_symmetric, RANGE, gas_of(w), vectors_of(w, BX), scalar_out_of(w))
CALL(gradient_symmetric, RANGE, gas_of(w), A(F), vector_out_of(w, O0))
CALL(cleaning_rates, RANGE, cleaning_of(w), cleaning_out_of(w))
CALL(gravity_direct, RANGE_ONE, A(M), X(GRAVITY), vector_out_of(w, O0), potential_of(w))
CALL(gravity_zeta, RANGE_ONE, A(M), A(RHO), scalar_out_of(w))
CALL(gravity_correction, RANGE_ONE, gas_of(w), A(F), X(GRAVITY), vector_out_of(w, O0))
CALL(grid_workspace, w->dim, w->n)
CALL(grid_build, w->dim, points_of(w), A(REACH), w->a[WORK], w->work_size, (sph_grid *)w->a[GRID])
CALL(grid_lists, w->dim, (const sph_grid *)w->a[GRID], query_of(w), I(I0), I(I1),
     (int64_t)w->number[CAPACITY], (int64_t *)w->a[REPORT])
CALL(grid_count, w->dim, (const sph_grid *)w->a[GRID], query_of(w), I(I0),
     (int64_t *)w->a[REPORT])
CALL(grid_renumber, (sph_grid *)w->a[GRID])
CALL(grid_permutation_own, (const sph_grid *)w->a[GRID], w->n, I(I0))
CALL(grid_renumber_own, (sph_grid *)w->a[GRID], w->n)
CALL(part_of, w->dim, points_of(w), A(REACH), (sph_part *)w->a[REPORT])
CALL(select_near, w->dim, points_of(w), A(REACH), (int)w->number[CRITERION], whole_part(), I(I0), (int64_t *)w->a[REPORT])
CALL(list_prune, w->n, w->n, I(START), I(INDEX), I(I0), (int64_t *)w->a[REPORT])
CALL(list_sort, w->n, w->n, I(START), I(INDEX), 0)
CALL(search, w->dim, points_of(w), A(REACH), (int)w->number[CRITERION], w->a[WORK], w->block_size, (sph_neighbors *)w->a[REPORT])
CALL(search_size, w->dim, w->n, (int64_t)w->number[CAPACITY])
CALL(permute, w->n, I(ORDER), R(F), w->array_stride, R(S0))
CALL(permute_inverse, w->n, I(ORDER), I(I0))
CALL(rebuild_due, w->dim, points_of(w), others_of(w), X(SKIN))
/* clang-format on */
static sph_index call_collision_sequential(const world *w)
{
    sph_collision_report *const report = (sph_collision_report *)w->a[REPORT];
    const sph_index answer = sph_collision_sequential(LIST, collision_of(w), vector_out_of(w, VX), report);
    if (answer >= 0 && report) CHECK(sphi_finite(report->energy));
    if (answer >= 0 && report && w->first == w->last) CHECK(report->collisions == 0 && report->coincident == 0);
    return answer;
}
static sph_index call_grid_permutation(const world *w) { return sph_grid_permutation((const sph_grid *)w->a[GRID]) ? 1 : 0; }
static sph_index call_curl_difference(const world *w) /* three components in any dimension */
{
    return sph_curl_difference(RANGE, gas_of(w), vectors_of(w, BX),
                               sph_vector_out_strided(R(O0), R(S0), R(S1), w->out_stride));
}
static sph_index call_density_adaptive(const world *w)
{
    sph_density_options d;
    sph_density_out o = {0};
    d.list_radius = A(REACH);
    d.eta = X(ETA);
    d.tolerance = X(TOLERANCE);
    o.h = R(GUESS);
    o.rho = R(S0);
    o.omega = R(S3);
    o.stride = w->out_stride;
    o.status = STATE;
    return sph_density_adaptive(RANGE, A(M), d, o);
}
static sph_index call_wall_adami(const world *w)
{
    sph_wall s;
    sph_wall_out o = {0};
    s.share = A(M);
    s.rho = A(U);
    s.p = A(P);
    s.v = vectors_of(w, VX);
    s.velocity = vectors_of(w, BX);
    s.normal = vectors_of(w, MX);
    s.gravity = along_x(w->number[GRAVITY]);
    o.p = R(S0);
    o.v = vector_out_of(w, O0);
    o.stride = w->out_stride;
    o.status = STATE;
    return sph_wall_adami(RANGE, s, o);
}
static sph_index call_free_surface(const world *w)
{
    sph_surface_out o = {0};
    o.normal = vector_out_of(w, O0);
    o.divergence = R(S1);
    o.eigenvalue = R(S2);
    o.stride = w->out_stride;
    o.status = STATE;
    return sph_free_surface(RANGE, o);
}
static sph_index call_shift_rates(const world *w)
{
    sph_fluid_out o = fluid_out_of(w);
    o.heating = 0;
    return sph_shift_rates(RANGE, still_of(w), vectors_of(w, BX), o);
}
static sph_index call_transport_adami(const world *w)
{
    sph_transport_out o = {0};
    o.background = vector_out_of(w, O0);
    o.stress = vector_out_of(w, O3);
    o.status = STATE;
    return sph_transport_adami(RANGE, still_of(w), vectors_of(w, BX), X(PARAMETER_A), o);
}
static sph_wall rows_wall_of(const world *w)
{
    sph_wall s = {0};
    s.share = A(M);
    s.rho = A(U);
    s.gravity = along_x(w->number[GRAVITY]);
    return s;
}
static sph_index call_wall_rows_adami(const world *w)
{
    sph_rows_out rows = row_out_of(w);
    rows.diagonal = R(S3); /* 1, also where there is no answer */
    return sph_wall_rows_adami(RANGE, rows_wall_of(w), rows, sph_scalar_out_strided(R(S0), w->out_stride, 0));
}
static sph_index call_wall_rows_eliminate(const world *w)
{
    sph_rows_out rows = row_out_of(w);
    rows.row = R(ROW);
    return sph_wall_rows_eliminate(LIST, rows_wall_of(w), rows, sph_scalar_out_strided(R(S3), w->out_stride, STATE));
}
static sph_index call_elliptic_diagnose(const world *w)
{
    sph_elliptic_report r = {0};
    r.sign_least = R(S0);
    r.sign_most = R(S1);
    r.xi = R(S2);
    r.continuity = R(S3);
    r.n = R(S4);
    r.n_bound = R(S5);
    r.eigenvalue_least = R(S6);
    r.eigenvalue_ratio = R(S7);
    r.stride = w->out_stride;
    r.status = STATE;
    return sph_elliptic_diagnose(RANGE, options_of(w), r);
}
static sph_gas plain_gas_of(const world *w)
{
    sph_gas s;
    s.medium = gas_of(w);
    s.p = A(P);
    s.u = A(U);
    s.cs = A(C);
    s.alpha = A(ALPHA);
    s.v = vectors_of(w, VX);
    s.beta = X(PARAMETER_A);
    s.alpha_u = X(PARAMETER_B);
    s.conductivity = SPH_CONDUCTIVITY_PRICE;
    return s;
}
static sph_index call_gas_rates(const world *w)
{
    sph_gas_out o = {0};
    o.acceleration = vector_out_of(w, O0);
    o.rate_u = R(S0);
    o.div_v = R(S1);
    o.v_sig = R(S2);
    o.stride = w->out_stride;
    o.status = STATE;
    return sph_gas_rates(RANGE, plain_gas_of(w), o);
}
static sph_velocity_gradient_out velocity_gradient_out_of(const world *w)
{
    sph_velocity_gradient_out o = {0};
    o.div = R(S0);
    o.curl = R(S1);
    o.shear = R(S2);
    o.square = R(S3);
    o.stride = w->out_stride;
    o.status = STATE;
    return o;
}
static sph_index call_velocity_gradient_difference(const world *w)
{
    return sph_velocity_gradient_difference(RANGE, gas_of(w), vectors_of(w, VX), velocity_gradient_out_of(w));
}
static sph_index call_velocity_gradient_cspm(const world *w)
{
    return sph_velocity_gradient_cspm(RANGE, vectors_of(w, VX), velocity_gradient_out_of(w));
}
static sph_index call_shock_indicator(const world *w)
{
    sph_shock_out o = {0};
    o.ratio = R(S0);
    o.v_sig = R(S1);
    o.stride = w->out_stride;
    o.status = STATE;
    return sph_shock_indicator(RANGE, plain_gas_of(w), A(F), o);
}
static sph_index call_resistivity_ohmic(const world *w)
{
    sph_ohmic s;
    sph_ohmic_out o = {0};
    s.medium = gas_of(w);
    s.eta = A(C);
    s.field = vectors_of(w, BX);
    o.rate_B = vector_out_of(w, O0);
    o.rate_u = R(S0);
    o.stride = w->out_stride;
    o.status = STATE;
    return sph_resistivity_ohmic(RANGE, s, o);
}
static sph_index call_mhd_rates(const world *w)
{
    sph_mhd s;
    sph_mhd_out o = {0};
    s.medium = gas_of(w);
    s.p = A(P);
    s.u = A(U);
    s.cs = A(C);
    s.alpha = A(ALPHA);
    s.alpha_B = A(ALPHA_B);
    s.v = vectors_of(w, VX);
    s.field = vectors_of(w, BX);
    s.psi = A(F);
    s.ch = X(CH);
    s.sigma = X(SIGMA);
    s.beta = X(PARAMETER_A);
    s.alpha_u = X(PARAMETER_B);
    s.tensile = X(PARAMETER_C);
    o.acceleration = vector_out_of(w, O0);
    o.rate_B = vector_out_of(w, O3);
    o.rate_u = R(S0);
    o.rate_psi = R(S1);
    o.div_B = R(S2);
    o.div_v = R(S3);
    o.v_sig = R(S4);
    o.stride = w->out_stride;
    o.status = STATE;
    return sph_mhd_rates(RANGE, s, o);
}

/* What a function has besides arrays and numbers. COUNTS: its answer is no number of failures. OPAQUE: its outputs are not one number a target (or pair). RAW: numbers are moved,
   not looked at. HEAVY: masses, and volumes if they are read, must be positive. KEEPS: only the first scalar output is 0 where there is no answer. SIZE: it answers a size.
   SAYS: REPORT begins with a number of pairs, and is written whatever the answer. TOTALS: it answers a total,
   which is given for no particles, too. CALLER: a function of sph.h. PARTS: of what has no answer only that is
   0 which overflowed. CHOOSES: the first entry of I0 or REPORT is no total that is 0 for nothing. */
enum {
    DIM = 1,
    KERNEL = 2,
    TARGETS = 4,
    COUNTED = 8,
    ENDS = 16,
    BINS = 32,
    STRIDE = 64,
    COUNTS = 128,
    OPAQUE = 256,
    RAW = 512,
    ONE_ROW = 1024,
    SIZE = 2048,
    HEAVY = 4096,
    KEEPS = 8192,
    SAYS = 16384,
    TOTALS = 32768,
    CALLER = 65536,
    PARTS = 131072,
    CHOOSES = 262144
};

typedef struct function {
    const char *name;
    sph_index (*call)(const world *);
    int has, dims;                               /* dims: bits 1, 2, 4 */
    uint64_t reads, may_read, writes, may_write; /* arrays that it must, and may be given */
    uint32_t numbers;
} function;

/* arrays by what they hold */
#define WEIGHTS (BIT(V) | BIT(M)) /* of any sign unless HEAVY */
#define MUST_BE_POSITIVE (BIT(RHO) | BIT(OMEGA))
#define NOT_BELOW_0 (BIT(INVERSE_M) | BIT(C) | XYZ(MX))
#define NEED_NOT_BE_0 (BIT(GUESS) | BIT(S1) | BIT(S2)) /* where there is no answer: h, conditioning, factor */

/* clang-format off */
#define LISTED (DIM | TARGETS | COUNTED)
#define SMOOTHED (LISTED | KERNEL)
#define ROWS_OF (BIT(START) | BIT(INDEX))
#define LIST_OF (XYZ(PX) | ROWS_OF)
#define SWEEP (LIST_OF | BIT(H))
#define VOLUMES (SWEEP | BIT(V))
#define MASSES (SWEEP | BIT(M))
#define GAS (MASSES | BIT(RHO) | BIT(OMEGA))
#define FLUID (MASSES | BIT(RHO) | BIT(P) | BIT(C) | XYZ(VX))
#define COLLIDERS (LIST_OF | BIT(INVERSE_M) | XYZ(VX))
#define DERIVATIVES (XYZ(O0) | HESSIAN | BIT(S0) | BIT(S1) | BIT(STATUS))
#define ROW_EXTRAS (BIT(S0) | BIT(S1) | BIT(S2) | BIT(STATUS))
#define CHOICE (N(GRADIENT) | N(MEAN) | N(CONDITIONING))
#define VISCOUS (N(VISCOSITY) | N(PARAMETER_A) | N(PARAMETER_B) | N(PARAMETER_C))
#define ALL 7
#define FUNCTION(name, ...) {"sph_" #name, call_##name, __VA_ARGS__}

static const function functions[] = { /* has, dims, reads, may read, writes, may write, numbers */
    FUNCTION(shepard_sum, SMOOTHED, ALL, VOLUMES, 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(interpolate_shepard, SMOOTHED, ALL, VOLUMES | BIT(F), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(density_summation, SMOOTHED, ALL, MASSES, 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(density_adaptive, SMOOTHED, ALL, LIST_OF | BIT(REACH) | BIT(M), 0, BIT(GUESS) | BIT(S0), BIT(S3) | BIT(STATUS), N(ETA) | N(TOLERANCE)),
    FUNCTION(gradient_difference, SMOOTHED, ALL, VOLUMES | BIT(F), 0, XYZ(O0), 0, 0),
    FUNCTION(gradient_cspm, SMOOTHED, ALL, VOLUMES | BIT(F), 0, XYZ(O0), BIT(S1) | BIT(STATUS), 0),
    FUNCTION(gradient_rows_cspm, SMOOTHED, ALL, VOLUMES, 0, XYZ(R0), BIT(S1) | BIT(STATUS), 0),
    FUNCTION(gradient_iad, SMOOTHED, ALL, VOLUMES | BIT(F), 0, XYZ(O0), BIT(S1) | BIT(STATUS), 0),
    FUNCTION(gradient_rows_iad, SMOOTHED, ALL, VOLUMES, 0, XYZ(R0), BIT(S1) | BIT(STATUS), 0),
    FUNCTION(gradient_correction_cspm, SMOOTHED, ALL, VOLUMES, 0, MATRIX_OUT, BIT(S1) | BIT(STATUS), 0),
    FUNCTION(gradient_correction_iad, SMOOTHED, ALL, VOLUMES, 0, MATRIX_OUT, BIT(S1) | BIT(STATUS), 0),
    FUNCTION(rk_correction, SMOOTHED | OPAQUE, ALL, VOLUMES, 0, BIT(S0) | XYZ(O0) | XYZ(O3) | BIT(R0), BIT(S1) | BIT(STATUS), 0),
    FUNCTION(interpolate_rk, SMOOTHED, ALL, VOLUMES | BIT(U) | XYZ(BX) | BIT(F), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(interpolate_rows_rk, SMOOTHED, ALL, VOLUMES | BIT(U) | XYZ(BX), 0, BIT(R0), ROW_EXTRAS, 0),
    FUNCTION(gradient_rk, SMOOTHED, ALL, VOLUMES | BIT(U) | XYZ(BX) | BIT(F), 0, XYZ(O0), 0, 0),
    FUNCTION(gradient_rows_rk, SMOOTHED, ALL, VOLUMES | BIT(U) | XYZ(BX), 0, XYZ(R0), BIT(S1) | BIT(STATUS), 0),
    FUNCTION(gas_rates_crk, SMOOTHED | HEAVY | PARTS, ALL, FLUID | BIT(V) | BIT(U) | XYZ(BX), 0, XYZ(O0), BIT(S0) | BIT(STATUS), VISCOUS),
    FUNCTION(gas_rates_iad, SMOOTHED | HEAVY | PARTS, ALL, FLUID | XYZ(BX), 0, XYZ(O0), BIT(S0) | BIT(STATUS), VISCOUS),
    FUNCTION(deformation_gradient, SMOOTHED, ALL, VOLUMES | XYZ(QX) | XYZ(BX), 0, MATRIX_OUT, 0, 0),
    FUNCTION(solid_acceleration, SMOOTHED, ALL, VOLUMES | XYZ(QX) | XYZ(BX) | XYZ(VX) | BIT(RHO) | BIT(C), 0, XYZ(O0), 0, N(PARAMETER_A)),
    FUNCTION(laplacian_brookshaw, SMOOTHED, ALL, VOLUMES | BIT(F), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(laplacian_rows_brookshaw, SMOOTHED, ALL, VOLUMES, 0, BIT(R0), ROW_EXTRAS, 0),
    FUNCTION(derivatives_cspm, SMOOTHED, ALL, VOLUMES | BIT(F), 0, 0, DERIVATIVES, N(LEAST)),
    FUNCTION(derivatives_icspm, SMOOTHED, ALL, VOLUMES | BIT(F), 0, 0, DERIVATIVES, N(LEAST)),
    FUNCTION(derivatives_fatehi_manzari, SMOOTHED, ALL, VOLUMES | BIT(F), 0, 0, DERIVATIVES, N(LEAST)),
    FUNCTION(derivatives_wls, SMOOTHED, ALL, VOLUMES | BIT(F), 0, 0, DERIVATIVES, N(LEAST)),
    FUNCTION(derivatives_rows_cspm, SMOOTHED, ALL, VOLUMES, 0, BIT(R0), ROW_EXTRAS, N(OPERATOR)),
    FUNCTION(derivatives_rows_icspm, SMOOTHED, ALL, VOLUMES, 0, BIT(R0), ROW_EXTRAS, N(OPERATOR)),
    FUNCTION(derivatives_rows_fatehi_manzari, SMOOTHED, ALL, VOLUMES, 0, BIT(R0), ROW_EXTRAS, N(OPERATOR)),
    FUNCTION(derivatives_rows_wls, SMOOTHED, ALL, VOLUMES, 0, BIT(R0), ROW_EXTRAS, N(OPERATOR)),
    FUNCTION(interpolate_mls, SMOOTHED, ALL, POSITIONS | ROWS_OF | BIT(H) | BIT(V) | BIT(F), 0, 0, XYZ(O0) | BIT(S0) | BIT(S1) | BIT(STATUS), N(LEAST)),
    FUNCTION(interpolate_liu, SMOOTHED, ALL, POSITIONS | ROWS_OF | BIT(H) | BIT(V) | BIT(F), 0, 0, XYZ(O0) | BIT(S0) | BIT(S1) | BIT(STATUS), N(LEAST)),
    FUNCTION(interpolate_rows_mls, SMOOTHED, ALL, POSITIONS | ROWS_OF | BIT(H) | BIT(V), 0, 0, XYZ(R0) | BIT(S1) | BIT(STATUS), N(LEAST)),
    FUNCTION(interpolate_rows_liu, SMOOTHED, ALL, POSITIONS | ROWS_OF | BIT(H) | BIT(V), 0, 0, XYZ(R0) | BIT(S1) | BIT(STATUS), N(LEAST)),
    FUNCTION(second_derivative_bim, KERNEL | TARGETS | COUNTED | ENDS, 1, VOLUMES | BIT(F), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(second_derivative_rows_bim, KERNEL | TARGETS | COUNTED | ENDS, 1, VOLUMES, 0, BIT(R0), ROW_EXTRAS, 0),
    FUNCTION(elliptic_brookshaw, SMOOTHED, ALL, VOLUMES | BIT(MX) | BIT(F), BIT(U), BIT(S0), BIT(STATUS), CHOICE),
    FUNCTION(elliptic_brookshaw_corrected, SMOOTHED, ALL, VOLUMES | BIT(MX) | BIT(F), BIT(U), BIT(S0), BIT(STATUS), CHOICE),
    FUNCTION(elliptic_schwaiger, SMOOTHED, ALL, VOLUMES | BIT(MX) | BIT(F), BIT(U), BIT(S0), BIT(STATUS), CHOICE),
    FUNCTION(elliptic_msph, SMOOTHED, ALL, VOLUMES | BIT(MX) | BIT(F), BIT(U), BIT(S0), BIT(STATUS), CHOICE),
    FUNCTION(elliptic_basic_degiuli_ban, SMOOTHED, ALL, VOLUMES | BIT(MX) | BIT(F), BIT(U), BIT(S0), BIT(STATUS), N(MEAN) | N(CONDITIONING)),
    FUNCTION(elliptic_rows_brookshaw, SMOOTHED, ALL, VOLUMES | BIT(MX), 0, BIT(R0), ROW_EXTRAS, CHOICE),
    FUNCTION(elliptic_rows_brookshaw_corrected, SMOOTHED, ALL, VOLUMES | BIT(MX), 0, BIT(R0), ROW_EXTRAS, CHOICE),
    FUNCTION(elliptic_rows_schwaiger, SMOOTHED, ALL, VOLUMES | BIT(MX), 0, BIT(R0), ROW_EXTRAS, CHOICE),
    FUNCTION(elliptic_rows_msph, SMOOTHED, ALL, VOLUMES | BIT(MX), 0, BIT(R0), ROW_EXTRAS, CHOICE),
    FUNCTION(elliptic_rows_basic_degiuli_ban, SMOOTHED, ALL, VOLUMES | BIT(MX), 0, BIT(R0), ROW_EXTRAS, N(MEAN) | N(CONDITIONING)),
    FUNCTION(elliptic_rows_anisotropic, SMOOTHED, ALL, VOLUMES | XYZ(MX), 0, BIT(R0), ROW_EXTRAS, 0),
    FUNCTION(elliptic_tensor, SMOOTHED, ALL, VOLUMES | XYZ(MX) | BIT(BY) | BIT(BZ) | BIT(F), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(elliptic_rows_tensor, SMOOTHED, ALL, VOLUMES | XYZ(MX) | BIT(BY) | BIT(BZ), 0, BIT(R0), ROW_EXTRAS, 0),
    FUNCTION(elliptic_rows_boundary, SMOOTHED, ALL, VOLUMES | BIT(MX) | XYZ(BX) | BIT(F) | BIT(U), 0, BIT(R0) | BIT(S0), BIT(S1) | BIT(S2) | BIT(STATUS), CHOICE),
    FUNCTION(elliptic_diagnose, SMOOTHED | KEEPS, ALL, VOLUMES, 0, 0, XYZ(S0) | XYZ(S3) | BIT(S6) | BIT(S7) | BIT(STATUS), N(GRADIENT) | N(CONDITIONING)),
    FUNCTION(rows_apply, TARGETS | COUNTED, ALL, ROWS_OF | BIT(ROW) | BIT(F), BIT(DIAGONAL), BIT(S0), BIT(STATUS), 0),
    FUNCTION(rows_monotone, TARGETS | COUNTED | COUNTS, ALL, ROWS_OF | BIT(ROW) | BIT(DIAGONAL), 0, 0, BIT(STATUS), 0),
    FUNCTION(rows_time_step, TARGETS | COUNTED | OPAQUE | TOTALS, ALL, ROWS_OF | BIT(ROW), 0, BIT(S0), 0, 0),
    FUNCTION(rows_growth, LISTED | OPAQUE | ONE_ROW, ALL, LIST_OF | BIT(ROW), 0, BIT(S0) | BIT(S1), 0, N(TAU) | N(WAVE)),
    FUNCTION(csr_size, TARGETS | SIZE, ALL, BIT(START), 0, 0, 0, 0),
    FUNCTION(csr_assemble, TARGETS | COUNTED | OPAQUE | TOTALS, ALL, ROWS_OF | BIT(ROW) | BIT(DIAGONAL), 0, BIT(I0) | BIT(I1) | BIT(R0), BIT(REPORT), 0),
    FUNCTION(fluid_rates_monaghan, SMOOTHED | HEAVY | PARTS, ALL, FLUID, 0, XYZ(O0), BIT(S0) | BIT(S1) | BIT(STATUS), VISCOUS),
    FUNCTION(fluid_rates_colagrossi, SMOOTHED | HEAVY | PARTS, ALL, FLUID, 0, XYZ(O0), BIT(S0) | BIT(S1) | BIT(STATUS), VISCOUS),
    FUNCTION(fluid_rates_hu_adams, SMOOTHED | HEAVY | PARTS, ALL, FLUID, 0, XYZ(O0), BIT(S0) | BIT(S1) | BIT(STATUS), VISCOUS),
    FUNCTION(fluid_rates_riemann, SMOOTHED | HEAVY | PARTS, ALL, FLUID, 0, XYZ(O0), BIT(S0) | BIT(S1) | BIT(STATUS), N(PARAMETER_A) | N(GRAVITY)),
    FUNCTION(density_number, SMOOTHED, ALL, MASSES, 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(viscosity_mu_morris, SMOOTHED, ALL, MASSES | BIT(RHO) | BIT(MX) | XYZ(VX), 0, XYZ(O0), 0, N(PARAMETER_C)),
    FUNCTION(viscosity_mu_monaghan_cleary, SMOOTHED, ALL, MASSES | BIT(RHO) | BIT(MX) | XYZ(VX), 0, XYZ(O0), 0, N(PARAMETER_C)),
    FUNCTION(viscosity_mu_espanol_revenga, SMOOTHED, ALL, MASSES | BIT(RHO) | BIT(MX) | BIT(C) | XYZ(VX), 0, XYZ(O0), 0, N(PARAMETER_C)),
    FUNCTION(velocity_xsph, SMOOTHED, ALL, MASSES | BIT(RHO) | XYZ(VX), 0, XYZ(O0), 0, N(PARAMETER_C)),
    FUNCTION(wall_adami, SMOOTHED | KEEPS, ALL, MASSES | BIT(U) | BIT(P) | XYZ(VX) | XYZ(BX), BIT(MX), BIT(S0) | XYZ(O0), BIT(STATUS), N(GRAVITY)),
    FUNCTION(density_diffusion_molteni, SMOOTHED, ALL, VOLUMES | BIT(RHO), BIT(VX) | BIT(U), BIT(S0), BIT(STATUS), N(PARAMETER_A) | N(CH)),
    FUNCTION(density_diffusion_antuono, SMOOTHED, ALL, VOLUMES | BIT(RHO) | XYZ(BX), BIT(VX) | BIT(U), BIT(S0), BIT(STATUS), N(PARAMETER_A) | N(CH)),
    FUNCTION(density_diffusion_fourtakas, SMOOTHED, ALL, VOLUMES | BIT(RHO), BIT(VX) | BIT(U), BIT(S0), BIT(STATUS), N(PARAMETER_A) | N(DENSITY) | N(RATIO) | N(GRAVITY)),
    FUNCTION(density_diffusion_rows_molteni, SMOOTHED, ALL, VOLUMES | BIT(RHO), BIT(U), BIT(R0), ROW_EXTRAS, N(PARAMETER_A) | N(CH)),
    FUNCTION(free_surface, SMOOTHED, ALL, VOLUMES, 0, XYZ(O0), BIT(S1) | BIT(S2) | BIT(STATUS), 0),
    FUNCTION(free_surface_cone, LISTED | COUNTS, ALL, SWEEP | BIT(F) | XYZ(BX), 0, BIT(STATUS), 0, 0),
    FUNCTION(shift_displacement, SMOOTHED, ALL, VOLUMES | BIT(U) | XYZ(BX), BIT(F), XYZ(O0), 0, N(PARAMETER_A) | N(PARAMETER_B) | N(RATIO)),
    FUNCTION(shift_rates, SMOOTHED | PARTS, ALL, VOLUMES | BIT(RHO) | XYZ(VX) | XYZ(BX), 0, XYZ(O0), BIT(S0) | BIT(STATUS), 0),
    FUNCTION(transport_adami, SMOOTHED | HEAVY | PARTS, ALL, MASSES | BIT(RHO) | XYZ(VX) | XYZ(BX), 0, XYZ(O0) | XYZ(O3), BIT(STATUS), N(PARAMETER_A)),
    FUNCTION(wall_rows_adami, SMOOTHED | KEEPS, ALL, MASSES | BIT(U), 0, BIT(R0) | BIT(S0), BIT(S1) | BIT(S2) | BIT(S3) | BIT(STATUS), N(GRAVITY)),
    FUNCTION(wall_rows_eliminate, LISTED, ALL, LIST_OF | BIT(M) | BIT(U) | BIT(ROW), 0, BIT(ROW) | BIT(S3), BIT(S0) | BIT(STATUS), N(GRAVITY)),
    FUNCTION(tension_css, SMOOTHED, ALL, VOLUMES | BIT(RHO) | XYZ(BX), 0, XYZ(O0), 0, N(PARAMETER_A) | N(CONDITIONING)),
    FUNCTION(tension_csf, SMOOTHED | PARTS, ALL, VOLUMES | BIT(RHO) | XYZ(BX), 0, XYZ(O0), BIT(S0) | BIT(STATUS), N(PARAMETER_A) | N(CONDITIONING)),
    FUNCTION(wall_gamma, DIM | KERNEL | TARGETS | COUNTED | PARTS, ALL, XYZ(PX) | BIT(H) | XYZ(BX) | XYZ(VX), 0, BIT(S0) | XYZ(O0), BIT(STATUS), 0),
    FUNCTION(wall_gradient, SMOOTHED, ALL, VOLUMES | BIT(RHO) | XYZ(BX) | BIT(U) | BIT(F), 0, XYZ(O0), 0, 0),
    FUNCTION(wall_laplacian, SMOOTHED, ALL, VOLUMES | BIT(RHO) | XYZ(BX) | XYZ(VX) | BIT(F), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(wall_gradient_rows, SMOOTHED, ALL, VOLUMES | BIT(RHO) | XYZ(BX) | BIT(U), 0, XYZ(R0) | XYZ(O0), BIT(S1) | BIT(STATUS), 0),
    FUNCTION(wall_laplacian_rows, SMOOTHED, ALL, VOLUMES | BIT(RHO) | XYZ(BX) | XYZ(VX), 0, BIT(R0) | BIT(S3), ROW_EXTRAS, 0),
    FUNCTION(pressure_factor_dfsph, SMOOTHED | HEAVY, ALL, MASSES | BIT(RHO), BIT(U), BIT(S0), BIT(STATUS), 0),
    FUNCTION(collision_sequential, LISTED | OPAQUE | TOTALS, ALL, COLLIDERS, 0, XYZ(VX), BIT(REPORT),
             N(DISTANCE) | N(RESTITUTION)),
    FUNCTION(collision_count, LISTED | COUNTS, ALL, COLLIDERS, 0, BIT(I0), 0, N(DISTANCE)),
    FUNCTION(collision_change_weighted, LISTED, ALL, COLLIDERS | BIT(COUNT), 0, XYZ(O0), 0, N(DISTANCE) | N(RESTITUTION)),
    FUNCTION(nearest_distance, LISTED, ALL, POSITIONS | ROWS_OF, 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(hexatic_order, TARGETS | COUNTED, 2, LIST_OF, 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(radial_distribution, LISTED | BINS | OPAQUE, ALL, LIST_OF, 0, BIT(S0), 0, N(DISTANCE) | N(DENSITY)),
    FUNCTION(coincident_count, LISTED | COUNTS, ALL, LIST_OF, 0, 0, 0, N(WITHIN)),
    FUNCTION(coincident_separate, LISTED | COUNTS, ALL, LIST_OF, 0, XYZ(O0), 0, N(WITHIN) | N(STEP)),
    FUNCTION(conserved_sums, LISTED | OPAQUE | TOTALS, ALL, XYZ(PX) | BIT(M) | XYZ(VX), 0, BIT(S0), 0, 0),
    FUNCTION(gas_rates, SMOOTHED | PARTS, ALL, GAS | BIT(P) | BIT(U) | BIT(C) | BIT(ALPHA) | XYZ(VX), 0, XYZ(O0), XYZ(S0) | BIT(STATUS), N(PARAMETER_A) | N(PARAMETER_B)),
    FUNCTION(velocity_gradient_difference, SMOOTHED | PARTS, ALL, GAS | XYZ(VX), 0, 0, XYZ(S0) | BIT(S3) | BIT(STATUS), 0),
    FUNCTION(velocity_gradient_cspm, SMOOTHED | PARTS, ALL, VOLUMES | XYZ(VX), 0, 0, XYZ(S0) | BIT(S3) | BIT(STATUS), 0),
    FUNCTION(shock_indicator, SMOOTHED | PARTS, ALL, GAS | BIT(C) | XYZ(VX) | BIT(F), 0, 0, BIT(S0) | BIT(S1) | BIT(STATUS), 0),
    FUNCTION(resistivity_ohmic, SMOOTHED | PARTS, ALL, GAS | BIT(C) | XYZ(BX), 0, XYZ(O0), BIT(S0) | BIT(STATUS), 0),
    FUNCTION(mhd_rates, SMOOTHED | PARTS, ALL, GAS | BIT(P) | BIT(U) | BIT(C) | BIT(ALPHA) | BIT(ALPHA_B) | XYZ(VX) | XYZ(BX), BIT(F), XYZ(O0) | XYZ(O3), XYZ(S0) | BIT(S3) | BIT(S4) | BIT(STATUS),
             N(CH) | N(SIGMA) | N(PARAMETER_A) | N(PARAMETER_B) | N(PARAMETER_C)),
    FUNCTION(cleaning_rates, SMOOTHED | PARTS, ALL, GAS | XYZ(BX) | BIT(F), BIT(U), XYZ(O0) | BIT(S0), BIT(S1) | BIT(STATUS), N(CH) | N(SIGMA)),
    FUNCTION(divergence_difference, SMOOTHED, ALL, GAS | XYZ(BX), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(divergence_symmetric, SMOOTHED, ALL, GAS | XYZ(BX), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(gradient_symmetric, SMOOTHED, ALL, GAS | BIT(F), 0, XYZ(O0), 0, 0),
    FUNCTION(curl_difference, SMOOTHED, ALL, GAS | XYZ(BX), 0, BIT(O0) | BIT(S0) | BIT(S1), 0, 0),
    FUNCTION(gravity_direct, KERNEL | TARGETS | COUNTED, 4, XYZ(PX) | BIT(H) | BIT(M), 0, XYZ(O0), BIT(S0), N(GRAVITY)),
    FUNCTION(gravity_zeta, KERNEL | TARGETS | COUNTED, 4, MASSES | BIT(RHO), 0, BIT(S0), BIT(STATUS), 0),
    FUNCTION(gravity_correction, KERNEL | TARGETS | COUNTED, 4, GAS | BIT(F), 0, XYZ(O0), 0, N(GRAVITY)),
    FUNCTION(grid_workspace, CALLER | DIM | COUNTED | SIZE, ALL, 0, 0, 0, 0, 0),
    FUNCTION(grid_build, CALLER | DIM | COUNTED | OPAQUE | TOTALS, ALL, XYZ(PX) | BIT(REACH), 0, BIT(WORK) | BIT(GRID), 0, 0),
    FUNCTION(grid_lists, CALLER | DIM | COUNTED | OPAQUE | SAYS | TOTALS, ALL, XYZ(PX) | BIT(REACH) | BIT(GRID), 0, BIT(I0) | BIT(I1) | BIT(REPORT), 0, N(CRITERION) | N(FLAGS) | N(CAPACITY)),
    FUNCTION(grid_count, CALLER | DIM | COUNTED | OPAQUE | SAYS | TOTALS, ALL, XYZ(PX) | BIT(REACH) | BIT(GRID), 0, BIT(I0) | BIT(REPORT), 0, N(CRITERION) | N(FLAGS)),
    FUNCTION(search, CALLER | DIM | COUNTED | OPAQUE | SAYS | TOTALS, ALL, XYZ(PX) | BIT(REACH), 0, BIT(WORK) | BIT(REPORT), 0, N(CRITERION)),
    FUNCTION(search_size, CALLER | DIM | COUNTED | SIZE, ALL, 0, 0, 0, 0, 0),
    FUNCTION(grid_permutation, CALLER | SIZE, ALL, BIT(GRID), 0, 0, 0, 0),
    FUNCTION(grid_renumber, CALLER | OPAQUE, ALL, 0, 0, BIT(GRID) | BIT(WORK), 0, 0),
    FUNCTION(grid_permutation_own, CALLER | OPAQUE, ALL, BIT(GRID), 0, BIT(I0), 0, 0),
    FUNCTION(grid_renumber_own, CALLER | OPAQUE, ALL, 0, 0, BIT(GRID) | BIT(WORK), 0, 0),
    FUNCTION(part_of, CALLER | DIM | COUNTED | OPAQUE | TOTALS | CHOOSES, ALL, XYZ(PX) | BIT(REACH), 0, BIT(REPORT), 0, 0),
    FUNCTION(select_near, CALLER | DIM | COUNTED | OPAQUE | SAYS | TOTALS | CHOOSES, ALL, XYZ(PX) | BIT(REACH), 0, BIT(I0) | BIT(REPORT), 0, N(CRITERION)),
    FUNCTION(list_prune, CALLER | COUNTED | OPAQUE | SAYS | TOTALS | CHOOSES, ALL, ROWS_OF, 0, BIT(INDEX) | BIT(I0) | BIT(REPORT), 0, 0),
    FUNCTION(list_sort, CALLER | COUNTED | OPAQUE, ALL, ROWS_OF, 0, BIT(INDEX), 0, 0),
    FUNCTION(permute, CALLER | COUNTED | STRIDE | RAW, ALL, BIT(ORDER) | BIT(F), 0, BIT(S0), 0, 0),
    FUNCTION(permute_inverse, CALLER | COUNTED | OPAQUE, ALL, BIT(ORDER), 0, BIT(I0), 0, 0),
    FUNCTION(rebuild_due, CALLER | DIM | COUNTED | COUNTS, ALL, POSITIONS, 0, 0, 0, N(SKIN)),
};
/* clang-format on */
enum { FUNCTIONS = sizeof functions / sizeof *functions };

/* ---------------------------------------------------------------- memory: good inputs, marked outputs, guards */

enum { GUARD = 64, GUARD_MARK = 0xFF, MARK = 0xA5 }; /* a number read from a guard is a NaN, an index -1 */

typedef struct ground {
    world good;
    sph_index pairs;
    size_t offset[ARRAYS], size[ARRAYS], total;
    unsigned char *live, *before, *good_bytes, *spoiled, *after;
} ground;
static ground grounds[4]; /* by dim */

static int is_there(int dim, int a) { return arrays[a].axis < dim; }
static uint64_t there(int dim, uint64_t set)
{
    int a;
    for (a = 0; a < ARRAYS; a++)
        if (!is_there(dim, a)) set &= ~BIT(a);
    return set;
}

static void build_grid(const world *w, sph_scalars radius)
{
    if (sph_grid_build(w->dim, points_of(w), radius, w->a[WORK], w->work_size, (sph_grid *)w->a[GRID]) != 0) abort();
}

static ground ground_new(int dim, int side)
{
    cloud c = cloud_lattice(dim, side, 1.6, 0.12, 9);
    const double support = 2.0 * 1.05 * (double)c.h;
    const size_t n = (size_t)c.n, room[] = {n, 0, n + 1, n * n, sph_search_size(dim, c.n, (int64_t)(n * n)), 256}; /* the block of a search is a workspace, too */
    static const size_t item[] = {sizeof(sph_real), sizeof(sph_index), 1, 1};
    ground g;
    world *const w = &g.good;
    pcg32 random;
    sph_index i, p;
    int a;
    cloud_set(&c, field_smooth);
    cloud_neighbors(&c, 1.1 * support);
    memset(&g, 0, sizeof g);
    g.pairs = (sph_index)c.pairs;
    for (a = 0; a < ARRAYS; a++) {
        g.offset[a] = g.total + GUARD;
        g.size[a] = (arrays[a].room == PAIR ? (size_t)c.pairs : room[arrays[a].room]) * item[arrays[a].holds];
        g.total += GUARD + (g.size[a] + 63) / 64 * 64;
    }
    g.total += GUARD;
    g.live = (unsigned char *)cloud_memory(g.total, 1);
    g.before = (unsigned char *)cloud_memory(g.total, 1);
    g.good_bytes = (unsigned char *)cloud_memory(g.total, 1);
    g.spoiled = (unsigned char *)cloud_memory(g.total, 1);
    g.after = (unsigned char *)cloud_memory(g.total, 1);
    memset(g.live, GUARD_MARK, g.total);
    for (a = 0; a < ARRAYS; a++) {
        w->a[a] = g.live + g.offset[a];
        memset(w->a[a], MARK, g.size[a]);
    }
    for (a = 0; a < NUMBERS; a++) w->number[a] = numbers[a].good;
    w->number[DISTANCE] = 1.1 * c.dx;
    w->number[WITHIN] = 0.01 * c.dx;
    w->number[CAPACITY] = (double)(n * n);
    w->k = SPH_CUBIC_SPLINE;
    w->dim = dim;
    w->bins = 7;
    w->right = (int)c.n - 1;
    w->last = w->n = w->m = c.n;
    w->stride = w->other_stride = w->array_stride = w->out_stride = 1;
    w->work_size = sph_grid_workspace(dim, c.n);
    w->block_size = room[WORK_ROOM];

    pcg32_seed(&random, 5, 5);
    for (a = QX; a <= DIAGONAL; a++)
        for (i = 0; i < c.n && a != ROW; i++) real_of(w, a)[i] = SPH_R(0.5 + pcg32_uniform(&random)); /* what is not said below */
    for (i = 0; i < c.n; i++) {
        const sph_real *const x[3] = {c.x, c.y, c.z};
        for (a = 0; a < 3; a++) {
            real_of(w, PX + a)[i] = x[a][i];
            real_of(w, QX + a)[i] = x[a][i] + SPH_R(0.01 * c.dx);
            real_of(w, VX + a)[i] = SPH_R(cloud_symmetric(&random));
        }
        real_of(w, H)[i] = real_of(w, GUESS)[i] = c.h * SPH_R(1.0 + 0.02 * (i % 3));
        real_of(w, REACH)[i] = SPH_R(2.0) * real_of(w, H)[i];
        real_of(w, V)[i] = real_of(w, M)[i] = c.V[i];
        real_of(w, F)[i] = c.f[i];
        index_of(w, COUNT)[i] = 1 + i % 3;
    }
    memcpy(w->a[START], c.start, (n + 1) * sizeof *c.start);
    memcpy(w->a[INDEX], c.index, (size_t)c.pairs * sizeof *c.index);
    for (i = 0; i < c.n; i++) { /* rows of a Laplacian */
        sph_real sum = SPH_R(0);
        for (p = c.start[i]; p < c.start[i + 1]; p++) sum += real_of(w, ROW)[p] = SPH_R(0.5 + pcg32_uniform(&random));
        real_of(w, DIAGONAL)[i] = -sum;
    }
    build_grid(w, scalars_of(w, REACH));
    memcpy(w->a[ORDER], sph_grid_permutation((const sph_grid *)w->a[GRID]), n * sizeof(sph_index));
    memcpy(g.good_bytes, g.live, g.total);
    cloud_free(&c);
    return g;
}
static void ground_free(ground *g)
{
    free(g->live);
    free(g->before);
    free(g->good_bytes);
    free(g->spoiled);
    free(g->after);
}
/* what sanitizers see: arrays with nothing between them */
static void ground_guards(const ground *g, int on)
{
    int a;
    for (a = 0; a < ARRAYS; a++) {
        unsigned char *const end = g->live + g->offset[a] + g->size[a], *const next = g->live + (a + 1 < ARRAYS ? g->offset[a + 1] : g->total);
        (void)end, (void)next;
        if (on) ASAN_POISON_MEMORY_REGION(end, (size_t)(next - end));
        else ASAN_UNPOISON_MEMORY_REGION(end, (size_t)(next - end));
    }
}

/* ---------------------------------------------------------------- faults: the columns of the tables */

static const double LIMIT = SPH_SINGLE ? (double)FLT_MAX : DBL_MAX, LEAST_NORMAL = SPH_SINGLE ? (double)FLT_MIN : DBL_MIN;
static int flushes(void) /* are denormal numbers taken for 0, as after -ffast-math? */
{
    const volatile sph_real least = SPH_R(LEAST_NORMAL);
    const volatile sph_real less = least * SPH_R(0.125);
    return !(less > SPH_R(0));
}
static double denormal(void) { return flushes() ? 4096.0 * LEAST_NORMAL : LEAST_NORMAL / 8.0; }

/* Each spoils w, whose arrays it may write to, in its way number v = 0, 1, ...: END past the last, NOT_THIS where that way is none for the function, else GO. */
enum { END, NOT_THIS, GO };
static char what[96];  /* the way, in words */
static int64_t needed; /* the size that would do */
static int64_t said;   /* the number of pairs that is to be said */
static const ground *here;

/* What a refusal must say: which argument (null: any), and the particle: -1 for none, -2 for any. */
static struct {
    const char *argument;
    long particle;
} blame;

static int nth(uint64_t set, int v) /* the member number v of a set, or -1 */
{
    int a;
    for (a = 0; a < 64; a++)
        if (set & BIT(a) && v-- == 0) return a;
    return -1;
}
static uint64_t inputs_of(const function *f, const world *w) { return there(w->dim, f->reads | f->may_read | (f->writes & (BIT(GUESS) | XYZ(VX)))); }
static uint64_t of_each(uint64_t set)
{
    int a;
    for (a = 0; a < ARRAYS; a++)
        if (arrays[a].holds != REAL || arrays[a].room != EACH) set &= ~BIT(a);
    return set;
}
static uint64_t positions_of(const function *f, const world *w) { return inputs_of(f, w) & POSITIONS; }
static uint64_t lengths_of(const function *f, const world *w) { return inputs_of(f, w) & (BIT(H) | BIT(REACH) | BIT(GUESS)); }
static uint64_t values_of(const function *f, const world *w)
{
    return f->has & RAW ? 0 : (of_each(inputs_of(f, w)) | (inputs_of(f, w) & BIT(ROW))) & ~(POSITIONS | BIT(H) | BIT(REACH) | BIT(GUESS));
}

static const char *argument_of(const function *f, int a);
/* Three places of an array of one number a particle, or a pair: in the last row, or the first. A function of one row looks at the last only. */
static int place(const function *f, const world *w, int a, int which, sph_index *at)
{
    const sph_index last = w->n - 1, neighbour = index_of(w, INDEX)[index_of(w, START)[last]];
    if (which == 2 && f->has & ONE_ROW) return 0;
    if (a == ROW) *at = which == 0 ? here->pairs - 1 : which == 1 ? index_of(w, START)[last] : 0;
    else *at = which == 0 ? last : which == 1 ? neighbour : 0;
    return 1;
}
static int set_one(const function *f, world *w, uint64_t set, int v, double value)
{
    const int a = nth(set, v / 4);
    sph_index at;
    if (a < 0) return END;
    snprintf(what, sizeof what, "%s %g", arrays[a].name, value);
    blame.argument = argument_of(f, a);
    blame.particle = 0;
    if (v % 4 == 3) { /* one for all */
        if (BIT(a) & (POSITIONS | BIT(GUESS) | BIT(ROW) | BIT(DIAGONAL)) || BIT(a) & f->writes) return NOT_THIS;
        w->same = BIT(a);
        real_of(w, a)[0] = SPH_R(value);
        return GO;
    }
    if (!place(f, w, a, v % 4, &at)) return NOT_THIS;
    real_of(w, a)[at] = SPH_R(value);
    blame.particle = a == ROW ? -2 : at; /* a row's are counted by entries */
    if (a == DIAGONAL && at > 0) w->first = 1;
    return GO;
}
static int set_either(const function *f, world *w, uint64_t set, int v, double one, double other) { return set_one(f, w, set, v / 2, v % 2 ? other : one); }

static int spoil_null(const function *f, world *w, int v)
{
    const int a = nth(there(w->dim, f->reads | f->writes) & ~(f->call == call_grid_renumber || f->call == call_grid_renumber_own ? BIT(WORK) : 0), v); /* the grid knows where it is */
    if (a < 0) return END;
    snprintf(what, sizeof what, "%s", arrays[a].name);
    w->a[a] = 0;
    blame.argument = a < (int)FIRST_OUTPUT && !(f->writes & BIT(a)) ? argument_of(f, a) : 0;
    if (POSITIONS & BIT(a)) blame.argument = "points";
    return GO;
}
/* nothing to do: no particles, or no targets, and no arrays but for those of totals */
static void leave_out(const function *f, world *w)
{
    const uint64_t kept = f->has & TOTALS ? BIT(GRID) | BIT(REPORT) | BIT(I0) | BIT(S0) : 0;
    int a;
    for (a = 0; a < ARRAYS; a++)
        if (!(kept & BIT(a))) w->a[a] = 0;
}
static void set_none(world *w)
{
    w->n = w->m = w->first = w->last = 0;
}
static int set_count(const function *f, world *w, int v, int count)
{
    static const char *const name[] = {"n", "n of the others", "bins", "bins 0", "two that differ", "n, no arrays"};
    if (v > 5) return END;
    snprintf(what, sizeof what, "%s", name[v]);
    if (v == 0) w->n = count;
    else if (v == 1) w->m = count;
    else if (v == 2 || v == 3) w->bins = v == 2 ? count : 0;
    else if (v == 4) w->m = w->n - 1;
    else {
        w->n = w->m = count;
        leave_out(f, w);
    }
    if (v == 1) return f->reads & BIT(QX) ? GO : NOT_THIS;
    if (v == 4) return f->call == call_rebuild_due ? GO : NOT_THIS;
    return f->has & (v == 2 || v == 3 ? BINS : COUNTED) ? GO : NOT_THIS;
}
static int spoil_count_0(const function *f, world *w, int v)
{
    if (v > 2) return END;
    snprintf(what, sizeof what, v == 0 ? "all arrays" : v == 1 ? "no arrays" : "none of the others");
    if (v < 2) set_none(w);
    else w->m = w->first = w->last = 0;
    if (v == 1) leave_out(f, w);
    return f->has & COUNTED && (v < 2 || (f->reads & BIT(QX) && f->has & TARGETS)) ? GO : NOT_THIS;
}
static int spoil_count_negative(const function *f, world *w, int v) { return set_count(f, w, v, -1); }
static int spoil_stride(const function *f, world *w, int v)
{
    if (v > 2) return END;
    if (v == 0) w->stride = 0;
    else if (v == 1) w->other_stride = 0;
    else w->array_stride = 0;
    return (v == 0 && f->reads & BIT(PX)) || (v == 1 && f->reads & BIT(QX)) || (v == 2 && f->has & STRIDE) ? GO : NOT_THIS;
}
static int spoil_no_target(const function *f, world *w, int v)
{
    if (v > 3) return END;
    w->first = w->last = v == 0 ? 0 : v == 2 ? w->n : w->n / 2;
    if (v == 3) leave_out(f, w);
    return f->has & TARGETS ? GO : NOT_THIS;
}
static int spoil_first(const function *f, world *w, int v)
{
    if (v > 2) return END;
    if (v == 0) w->first = -1;
    else if (v == 1) w->left = -1;
    else w->right = -1;
    return f->has & (v == 0 ? TARGETS : ENDS) ? GO : NOT_THIS;
}
static int spoil_order(const function *f, world *w, int v)
{
    if (v > 0) return END;
    w->first = 2;
    w->last = 1;
    return f->has & TARGETS && !(f->has & ONE_ROW) ? GO : NOT_THIS;
}
static int spoil_last(const function *f, world *w, int v)
{
    if (v > 3) return END;
    if (v == 0) w->last = w->n + 1;
    else if (v == 1) w->left = (int)w->n;
    else if (v == 2) w->right = (int)w->n;
    else w->n++; /* a target that is no source of the grid */
    return (v == 0 && f->has & TARGETS && f->has & COUNTED) || ((v == 1 || v == 2) && f->has & ENDS) || (v == 3 && f->reads & BIT(GRID) && f->has & COUNTED)
               ? GO
               : NOT_THIS;
}
static int spoil_dim(const function *f, world *w, int v)
{
    static const int wrong[] = {0, 4, -1};
    if (v > 5) return END;
    w->dim = wrong[v % 3];
    if (v > 2) set_none(w);
    if (v > 2 && f->has & COUNTED) leave_out(f, w);
    blame.argument = "dim";
    return f->has & DIM ? GO : NOT_THIS;
}
static int spoil_kernel(const function *f, world *w, int v)
{
    const int gravity = f->call == call_gravity_direct || f->call == call_gravity_zeta;
    if (v > 5) return END;
    w->k = v % 3 == 0 ? -1 : v % 3 == 1 ? (int)SPH_KERNEL_COUNT : (int)SPH_GAUSSIAN;
    if (v > 2) set_none(w);
    if (v > 2) leave_out(f, w);
    blame.argument = "kernel";
    return f->has & KERNEL && (v % 3 < 2 || gravity) ? GO : NOT_THIS;
}
static int spoil_numbers(const function *f, world *w, int v, int kind)
{
    const double reals[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, -1.0, 0.0, 1.0},
                 flags[] = {-1.0, 16.0, SPH_LIST_FOREIGN | SPH_LIST_SELF, SPH_LIST_FOREIGN | SPH_LIST_HALF};
    const int i = v / 6, u = v % 6;
    int range;
    if (i >= NUMBERS) return END;
    range = numbers[i].range;
    if (!(f->numbers & N(i)) || numbers[i].kind != kind) return NOT_THIS;
    if (range >= ONE_OF || range == NO_LESS_THAN_0) {
        if (u > (range >= ONE_OF)) return NOT_THIS;
        w->number[i] = u ? range - ONE_OF + 1 : -1.0;
    } else if (range == OF_FLAGS) {
        if (u > 3) return NOT_THIS;
        w->number[i] = flags[u];
    } else {
        if (u >= (range == ANY_NUMBER ? 3 : range == NOT_NEGATIVE ? 4 : range == POSITIVE ? 5 : 6) || (range == BELOW_ONE && u == 4)) return NOT_THIS;
        w->number[i] = reals[u];
    }
    snprintf(what, sizeof what, "%s %g", numbers[i].name, w->number[i]);
    return GO;
}
static int spoil_parameter(const function *f, world *w, int v) { return spoil_numbers(f, w, v, VALUE_); }
static int spoil_length(const function *f, world *w, int v) { return spoil_numbers(f, w, v, LENGTH); }
static int spoil_box(const function *f, world *w, int v)
{
    const double wrong[] = {-1.0, (double)NAN, (double)INFINITY, denormal()};
    if (v >= 4 * w->dim) return END;
    w->box[v / 4] = wrong[v % 4];
    snprintf(what, sizeof what, "%g", wrong[v % 4]);
    return f->reads & BIT(PX) && !(v % 4 == 3 && flushes()) ? GO : NOT_THIS;
}

static int spoil_x_nan(const function *f, world *w, int v) { return set_one(f, w, positions_of(f, w), v, (double)NAN); }
static int spoil_x_inf(const function *f, world *w, int v) { return set_either(f, w, positions_of(f, w), v, (double)INFINITY, -0.75 * LIMIT); }
static int spoil_h_low(const function *f, world *w, int v) { return set_either(f, w, lengths_of(f, w), v, 0.0, -0.1); }
static int spoil_h_nan(const function *f, world *w, int v) { return set_one(f, w, lengths_of(f, w), v, (double)NAN); }
static int spoil_h_inf(const function *f, world *w, int v) { return set_one(f, w, lengths_of(f, w), v, (double)INFINITY); }
static int spoil_value_nan(const function *f, world *w, int v) { return set_one(f, w, values_of(f, w), v, (double)NAN); }
static int spoil_value_inf(const function *f, world *w, int v) { return set_either(f, w, values_of(f, w), v, (double)INFINITY, -(double)INFINITY); }
static int spoil_weight(const function *f, world *w, int v) { return set_either(f, w, f->reads & WEIGHTS, v, 0.0, -1.0); }
static int spoil_sign(const function *f, world *w, int v)
{
    const uint64_t set = there(w->dim, f->reads & (MUST_BE_POSITIVE | NOT_BELOW_0));
    const int a = nth(set, v / 8);
    return set_either(f, w, set, v, -1.0, a >= 0 && MUST_BE_POSITIVE & BIT(a) ? 0.0 : -0.5);
}
static int spoil_self(const function *f, world *w, int v)
{
    if (v > 0) return END;
    index_of(w, INDEX)[index_of(w, START)[w->n - 1]] = w->n - 1;
    blame.argument = "list";
    blame.particle = w->n - 1;
    return f->reads & BIT(INDEX) ? GO : NOT_THIS;
}
static int spoil_entry(const function *f, world *w, int v)
{
    const int a = f->reads & BIT(ORDER) ? ORDER : INDEX;
    const sph_index wrong[] = {-1, w->n, INT32_MAX, INT32_MIN};
    if (v > 7) return END;
    if (v >= 4 && f->has & ONE_ROW) return NOT_THIS;
    index_of(w, a)[v >= 4 ? 0 : a == ORDER ? w->n - 1 : here->pairs - 1] = wrong[v % 4];
    blame.argument = "list";
    blame.particle = v >= 4 ? 0 : w->n - 1;
    return f->reads & (BIT(INDEX) | BIT(ORDER)) ? GO : NOT_THIS;
}
static int spoil_start(const function *f, world *w, int v)
{
    sph_index *const start = index_of(w, START), n = w->n;
    if (v > 3) return END;
    if (v == 0) start[n] = start[n - 1] - 1;
    else if (v == 1) start[n - 1] = start[n] + 1;
    else if (v == 2) start[0] = -1;
    else start[1] = start[2] + 1;
    blame.argument = "list";
    blame.particle = v < 2 ? n - 1 : v == 2 ? 0 : 1;
    return f->reads & BIT(START) && !(v > 1 && f->has & ONE_ROW) ? GO : NOT_THIS;
}
/* how far the sums of a function reach, and so how large a box must be */
static double reach_of(const function *f, const world *w)
{
    if (f->reads & BIT(H)) return 2.0 * (double)real_of(w, H)[2]; /* the largest */
    if (f->reads & BIT(REACH)) return (double)real_of(w, REACH)[2];
    if (f->numbers & N(DISTANCE)) return w->number[DISTANCE];
    return f->numbers & N(WITHIN) ? w->number[WITHIN] : 0.0;
}
/* The names of the arguments that the arrays stand for, and where a function has others for them. */
static const char *argument_of(const function *f, int a)
{
    static const struct {
        const char *names; /* of functions, how they begin */
        uint64_t set;
        const char *argument;
    } named[] = {{"sph_density_diffusion", BIT(U), "share"},
                 {"sph_density_diffusion", XYZ(BX), "gradient"},
                 {"sph_free_surface", BIT(F), "eigenvalue"},
                 {"sph_free_surface", XYZ(BX), "normal"},
                 {"sph_shift_displacement", BIT(U), "strength"},
                 {"sph_shift_displacement", BIT(F), "eigenvalue"},
                 {"sph_shift_displacement", XYZ(BX), "normal"},
                 {"sph_shift_rates", XYZ(BX), "shift"},
                 {"sph_transport", XYZ(BX), "transport"},
                 {"sph_wall_adami", BIT(M), "share"},
                 {"sph_wall_rows_adami", BIT(M), "share"},
                 {"sph_wall_rows_adami", BIT(U), "rho"},
                 {"sph_wall_rows_eliminate", BIT(M), "share"},
                 {"sph_wall_rows_eliminate", BIT(U), "rho"},
                 {"sph_viscosity_mu_espanol_revenga", BIT(C), "mu.bulk"},
                 {"sph_wall_gamma", XYZ(BX), "elements.a"},
                 {"sph_wall_gamma", XYZ(VX), "elements.b"},
                 {"sph_wall_gradient", BIT(RHO), "wall.gamma"},
                 {"sph_wall_gradient", XYZ(BX), "wall.gradient"},
                 {"sph_wall_gradient", BIT(U), "wall.value"},
                 {"sph_wall_laplacian", BIT(RHO), "wall.gamma"},
                 {"sph_wall_laplacian", XYZ(BX), "wall.gradient"},
                 {"sph_wall_laplacian", XYZ(VX), "wall.slope"},
                 {"sph_pressure_factor", BIT(U), "moves"},
                 {"sph_tension_css", XYZ(BX), "normal"},
                 {"sph_tension_csf", XYZ(BX), "normal"},
                 {"sph_wall_adami", BIT(U), "rho"},
                 {"sph_wall_adami", XYZ(BX), "velocity"},
                 {"sph_wall_adami", XYZ(MX), "normal"},
                 {"sph_elliptic_rows_anis", BIT(MX), "mobility.x"},
                 {"sph_elliptic_rows_anis", BIT(MY), "mobility.y"},
                 {"sph_elliptic_rows_anis", BIT(MZ), "mobility.z"},
                 {"sph_elliptic_tensor", XYZ(MX) | XYZ(BX), "mobility"},
                 {"sph_elliptic_rows_tensor", XYZ(MX) | XYZ(BX), "mobility"},
                 {"sph_interpolate_rk", BIT(U), "rk.scale"},
                 {"sph_interpolate_rows_rk", BIT(U), "rk.scale"},
                 {"sph_gradient_rk", BIT(U), "rk.scale"},
                 {"sph_gradient_rows_rk", BIT(U), "rk.scale"},
                 {"sph_gas_rates_crk", BIT(U), "rk.scale"},
                 {"sph_interpolate_rk", XYZ(BX), "rk.slope"},
                 {"sph_interpolate_rows_rk", XYZ(BX), "rk.slope"},
                 {"sph_gradient_rk", XYZ(BX), "rk.slope"},
                 {"sph_gradient_rows_rk", XYZ(BX), "rk.slope"},
                 {"sph_gas_rates_crk", XYZ(BX), "rk.slope"},
                 {"sph_gas_rates_iad", XYZ(BX), "inverse"},
                 {"sph_deformation", XYZ(BX), "inverse"},
                 {"sph_solid", XYZ(BX), "inverse"},
                 {"sph_solid", XYZ(VX), "stress"},
                 {"sph_solid", BIT(RHO), "density"},
                 {"sph_solid", BIT(C), "modulus"},
                 {"sph_elliptic_rows_bound", BIT(F), "alpha"},
                 {"sph_elliptic_rows_bound", BIT(U), "beta"},
                 {"sph_elliptic_rows_bound", XYZ(BX), "normal"},
                 {"sph_elliptic", BIT(MX), "m"},
                 {"sph_elliptic", BIT(F), "u"},
                 {"sph_elliptic", BIT(U), "options.source"},
                 {"sph_rows", BIT(F), "u"},
                 {"sph_cleaning", BIT(F), "psi"},
                 {"sph_cleaning", BIT(U), "div_v"},
                 {"sph_gas_rates_crk", BIT(C), "c"},
                 {"sph_gas_rates_iad", BIT(C), "c"},
                 {"sph_gas", BIT(C), "cs"},
                 {"sph_gas", BIT(U), "u"},
                 {"sph_shock", BIT(C), "cs"},
                 {"sph_shock", BIT(F), "div_v"},
                 {"sph_resistivity", BIT(C), "eta"},
                 {"sph_mhd", BIT(F), "psi"},
                 {"sph_mhd", BIT(C), "cs"},
                 {"sph_mhd", BIT(U), "u"},
                 {"sph_viscosity", BIT(MX), "mu"},
                 {"sph_gravity", BIT(F), "zeta"},
                 {"sph_", BIT(PX) | BIT(QX), "x"},
                 {"sph_", BIT(PY) | BIT(QY), "y"},
                 {"sph_", BIT(PZ) | BIT(QZ), "z"},
                 {"sph_", BIT(H), "h"},
                 {"sph_", BIT(REACH), "list_radius"},
                 {"sph_", BIT(GUESS), "out.h"},
                 {"sph_", BIT(V), "volume"},
                 {"sph_", BIT(M), "m"},
                 {"sph_", BIT(RHO), "rho"},
                 {"sph_", BIT(OMEGA), "omega"},
                 {"sph_", BIT(INVERSE_M), "inverse_mass"},
                 {"sph_", BIT(F), "f"},
                 {"sph_", BIT(P), "p"},
                 {"sph_", BIT(C), "c"},
                 {"sph_", BIT(ALPHA), "alpha"},
                 {"sph_", BIT(ALPHA_B), "alpha_B"},
                 {"sph_", XYZ(VX), "v"},
                 {"sph_", XYZ(BX), "field"},
                 {"sph_", BIT(ROW), "row"},
                 {"sph_", BIT(DIAGONAL), "diagonal"},
                 {"sph_", BIT(START) | BIT(INDEX), "list"},
                 {"sph_", BIT(COUNT), "count"}};
    size_t i;
    for (i = 0; i < sizeof named / sizeof *named; i++)
        if (named[i].set & BIT(a) && strncmp(f->name, named[i].names, strlen(named[i].names)) == 0)
            return named[i].argument;
    return 0;
}
static int looks_at_box(const function *f) { return f->reads & BIT(PX) && f->call != call_gravity_direct && f->call != call_conserved_sums; }
static int spoil_small_box(const function *f, world *w, int v)
{
    const double reach = reach_of(f, w);
    int c;
    if (v >= w->dim) return END;
    for (c = 0; c < w->dim; c++) w->box[c] = 8.0;
    w->box[v] = 1.8 * reach;
    if (!looks_at_box(f) || !(reach > 0.0)) return NOT_THIS;
    if (f->reads & BIT(GRID)) { /* the grid's own box, good for its reach but not for these radii */
        const sph_real half = SPH_R(0.5 * reach);
        build_grid(w, sph_scalars_same(&half));
    }
    return GO;
}
static int spoil_image(const function *f, world *w, int v)
{
    const int a = nth(positions_of(f, w), v);
    int c;
    if (a < 0) return END;
    for (c = 0; c < w->dim; c++) w->box[c] = 8.0;
    if (f->reads & BIT(GRID)) build_grid(w, scalars_of(w, REACH)); /* of its own box */
    real_of(w, a)[w->n - 1] -= SPH_R(8.0 * 2097152.0);
    blame.argument = "points";
    blame.particle = w->n - 1;
    snprintf(what, sizeof what, "%s", arrays[a].name);
    return looks_at_box(f) ? GO : NOT_THIS;
}

static int spoil_nothing(const function *f, world *w, int v)
{
    int c;
    if (v > 2) return END;
    if (v == 1) w->same = of_each(inputs_of(f, w)) & ~(POSITIONS | BIT(GUESS) | BIT(DIAGONAL) | f->writes);
    snprintf(what, sizeof what, v == 0 ? "separate" : v == 1 ? "one value for all" : "a box");
    for (c = 0; v == 2 && c < w->dim; c++) w->box[c] = 8.0;
    return (v == 1 && f->has & RAW) || (v == 2 && (!looks_at_box(f) || f->has & ENDS)) ? NOT_THIS : GO;
}
static int spoil_part(const function *f, world *w, int v) /* what is outside is nobody's business */
{
    if (v > 0) return END;
    w->first = 1;
    w->last = w->n - 1;
    index_of(w, INDEX)[0] = index_of(w, INDEX)[here->pairs - 1] = -7;
    real_of(w, ROW)[0] = real_of(w, ROW)[here->pairs - 1] = SPH_R(NAN);
    real_of(w, GUESS)[0] = real_of(w, GUESS)[w->n - 1] = real_of(w, DIAGONAL)[0] = SPH_R(NAN);
    return f->has & TARGETS ? GO : NOT_THIS;
}
/* each is left out; and all, with the components that the dimension has not and what the function does not
   use, as the volumes of a cloud where it reads masses */
static int spoil_optional(const function *f, world *w, int v)
{
    const uint64_t all = f->reads | f->may_read | f->writes | f->may_write, beyond = all & ~there(w->dim, all), set = there(w->dim, f->may_read | f->may_write);
    int a = nth(set, v);
    if (a >= 0) {
        snprintf(what, sizeof what, "no %s", arrays[a].name);
        w->a[a] = 0;
        return GO;
    }
    if ((v > 0 && nth(set, v - 1) < 0) || !(set | beyond)) return END;
    for (a = 0; a < ARRAYS; a++)
        if (!(all & BIT(a)) || (set | beyond) & BIT(a)) w->a[a] = 0;
    return GO;
}
static int spoil_twice(const function *f, world *w, int v)
{
    const int a = f->reads & BIT(ORDER) ? ORDER : INDEX;
    if (v > 0) return END;
    index_of(w, a)[1] = index_of(w, a)[0];
    index_of(w, a)[(a == ORDER ? w->n : here->pairs) - 1] = index_of(w, a)[(a == ORDER ? w->n : here->pairs) - 2];
    return f->reads & (BIT(INDEX) | BIT(ORDER)) ? GO : NOT_THIS;
}
static void reverse(sph_index *a, sph_index n)
{
    sph_index i;
    for (i = 0; i < n / 2; i++) {
        const sph_index t = a[i];
        a[i] = a[n - 1 - i];
        a[n - 1 - i] = t;
    }
}
static int spoil_unsorted(const function *f, world *w, int v)
{
    const sph_index *const start = index_of(w, START);
    sph_index i;
    if (v > 0) return END;
    for (i = 0; i < w->n; i++) reverse(index_of(w, INDEX) + start[i], start[i + 1] - start[i]);
    reverse(index_of(w, ORDER), w->n);
    return f->reads & (BIT(INDEX) | BIT(ORDER)) ? GO : NOT_THIS;
}
static int spoil_lonely(const function *f, world *w, int v) /* empty rows, with an index and without */
{
    if (v > 1) return END;
    memset(w->a[START], 0, ((size_t)w->n + 1) * sizeof(sph_index));
    if (v) w->a[INDEX] = 0;
    return f->reads & BIT(INDEX) ? GO : NOT_THIS;
}
/* positions are what they are now: the search goes by a grid of them */
static int moved(const function *f, const world *w)
{
    if (!(f->reads & BIT(PX))) return NOT_THIS;
    if (f->reads & BIT(GRID)) build_grid(w, scalars_of(w, REACH));
    if (f->has & ENDS) blame.particle = -2; /* which may be at one place now */
    return GO;
}
static int spoil_coincident(const function *f, world *w, int v)
{
    const sph_index i = w->n - 1, j = index_of(w, INDEX)[index_of(w, START)[i]];
    int c;
    if (v > 0) return END;
    for (c = 0; c < w->dim; c++) real_of(w, PX + c)[i] = real_of(w, PX + c)[j];
    return moved(f, w);
}
static int spoil_all_coincident(const function *f, world *w, int v)
{
    sph_index i;
    int c;
    if (v > 1) return END;
    for (c = 0; c < w->dim; c++)
        for (i = 0; i < w->n; i++) real_of(w, PX + c)[i] = v ? SPH_R(0.25 * LIMIT) : real_of(w, PX + c)[0];
    if (v) w->number[STEP] = LIMIT;
    return moved(f, w);
}
static int spoil_one_cell(const function *f, world *w, int v) /* each a neighbour of all */
{
    sph_index i, j, p = 0;
    if (v > 0) return END;
    for (i = 0; i < w->n; i++) {
        index_of(w, START)[i] = p;
        for (j = 0; j < w->n; j++)
            if (i != j) index_of(w, INDEX)[p++] = j;
        real_of(w, H)[i] *= SPH_R(16);
        real_of(w, REACH)[i] *= SPH_R(16);
    }
    index_of(w, START)[w->n] = p;
    w->number[DISTANCE] *= 16.0;
    w->number[WITHIN] *= 2000.0;
    if (f->reads & (BIT(ROW) | BIT(ORDER))) return NOT_THIS;
    return moved(f, w);
}
static int scale(const function *f, world *w, double positions, double lengths)
{
    sph_index i;
    int c;
    for (i = 0; i < w->n; i++) {
        for (c = PX; c <= QZ; c++) real_of(w, c)[i] *= SPH_R(positions);
        real_of(w, H)[i] *= SPH_R(lengths);
        real_of(w, REACH)[i] *= SPH_R(lengths);
        real_of(w, GUESS)[i] *= SPH_R(lengths);
    }
    for (c = 0; c < NUMBERS; c++)
        if (numbers[c].kind == LENGTH || c == SKIN) w->number[c] *= lengths;
    if (SPH_SINGLE && f->reads & BIT(GRID) && f->reads & BIT(PX)) return GO; /* there is no grid of such a reach */
    return moved(f, w);
}
static int spoil_at_1e30(const function *f, world *w, int v)
{
    sph_index i;
    int c;
    if (v > 0) return END;
    for (i = 0; i < w->n; i++)
        for (c = PX; c <= QZ; c++) real_of(w, c)[i] += SPH_R(1e30);
    return moved(f, w);
}
static int spoil_1e30(const function *f, world *w, int v) /* and so far apart that only the square of a distance overflows */
{
    sph_index i;
    int c;
    for (i = 0; v == 1 && i < w->n; i++)
        for (c = PX; c <= QZ; c++) real_of(w, c)[i] = SPH_R((i % 2 ? 0.45 : -0.45) * LIMIT / 1e30);
    return v > 1 ? END : scale(f, w, 1e30, 1e30);
}
static int spoil_1e_30(const function *f, world *w, int v) { return v > 0 ? END : scale(f, w, 1e-30, 1e-30); }
static int spoil_denormal_x(const function *f, world *w, int v)
{
    if (v > 1) return END;
    if (v == 1 && (f->reads & BIT(GRID) || f->writes & BIT(GRID) || f->call == call_search || f->has & CHOOSES)) return NOT_THIS;
    return scale(f, w, denormal(), v ? denormal() : 1.0);
}
static int set_values(const function *f, world *w, double size)
{
    const uint64_t set = values_of(f, w), positive = f->reads & (MUST_BE_POSITIVE | NOT_BELOW_0 | (f->has & HEAVY ? WEIGHTS : 0));
    sph_index i;
    int a;
    for (a = 0; a < ARRAYS; a++)
        for (i = 0; set & BIT(a) && i < (a == ROW ? here->pairs : w->n); i++)
            real_of(w, a)[i] = SPH_R((i % 2 ? size : 0.5 * size) * (i % 3 == 0 && !(positive & BIT(a)) ? -1.0 : 1.0));
    return set ? GO : NOT_THIS;
}
static int spoil_denormal_values(const function *f, world *w, int v) { return v > 0 ? END : set_values(f, w, denormal()); }
static int spoil_huge_values(const function *f, world *w, int v) { return v > 0 ? END : set_values(f, w, LIMIT); }

static int spoil_capacity(const function *f, world *w, int v) /* every size up to what is needed */
{
    const int work = f->call == call_grid_build, column = f->call == call_csr_assemble, block = f->call == call_search;
    const int64_t fixed = (int64_t)sph_search_size(w->dim, w->n, 0), most = w->dim == 1 ? 8 : w->dim == 2 ? 32 : 128;
    int64_t pairs = 0;
    needed = said = work ? (int64_t)w->work_size : column ? here->pairs + w->n : 0;
    if (f->numbers & N(CAPACITY) || block) {
        if (sph_grid_count(w->dim, (const sph_grid *)w->a[GRID], sph_query_of(points_of(w), (int)w->number[CRITERION], scalars_of(w, REACH), 0), index_of(w, I0), &pairs) != 0)
            abort();
        memset(w->a[I0], MARK, here->size[I0]);
        needed = said = pairs;
    }
    if (block) {
        needed = (int64_t)sph_search_size(w->dim, w->n, pairs);
        said = v >= fixed ? pairs : w->n * (most < w->n - 1 ? most : w->n - 1); /* where there is no grid: a guess */
    }
    snprintf(what, sizeof what, "%d of %ld", v, (long)needed);
    if (v >= needed) return END;
    w->work_size = w->block_size = (size_t)v;
    w->number[CAPACITY] = v;
    return GO;
}
static int spoil_alias(const function *f, world *w, int v) /* each output on each input of its shape */
{
    uint64_t ins = of_each(inputs_of(f, w)) & ~f->writes, outs = of_each(there(w->dim, f->writes | f->may_write)) & ~(BIT(FIRST_OUTPUT) - 1);
    int in, out, count = 0;
    if (f->has & OPAQUE) return END;
    while (nth(ins, count) >= 0) count++;
    in = count ? nth(ins, v % count) : -1;
    out = count ? nth(outs, v / count) : -1;
    if (in < 0 || out < 0) return END;
    snprintf(what, sizeof what, "%s on %s", arrays[out].name, arrays[in].name);
    w->a[out] = w->a[in];
    return GO;
}

/* clang-format off */
static const struct column {
    const char *name;
    int (*spoil)(const function *, world *, int);
} columns[] = {
    {"null", spoil_null}, {"count 0", spoil_count_0}, {"count < 0", spoil_count_negative}, {"stride 0", spoil_stride}, {"no target", spoil_no_target},
    {"first < 0", spoil_first}, {"first > last", spoil_order}, {"last > n", spoil_last}, {"dim", spoil_dim}, {"kernel", spoil_kernel}, {"parameter", spoil_parameter},
    {"length", spoil_length}, {"box", spoil_box},
    {"x NaN", spoil_x_nan}, {"x inf", spoil_x_inf}, {"h <= 0", spoil_h_low}, {"h NaN", spoil_h_nan}, {"h inf", spoil_h_inf}, {"value NaN", spoil_value_nan},
    {"value inf", spoil_value_inf}, {"weight <= 0", spoil_weight}, {"sign", spoil_sign}, {"self", spoil_self}, {"entry", spoil_entry}, {"start", spoil_start},
    {"small box", spoil_small_box}, {"far image", spoil_image},
    {"valid", spoil_nothing}, {"part", spoil_part}, {"optional", spoil_optional}, {"twice", spoil_twice}, {"unsorted", spoil_unsorted}, {"lonely", spoil_lonely},
    {"coincident", spoil_coincident}, {"all coincident", spoil_all_coincident}, {"one cell", spoil_one_cell}, {"at 1e30", spoil_at_1e30}, {"1e30", spoil_1e30},
    {"1e-30", spoil_1e_30}, {"denormal x", spoil_denormal_x}, {"denormal values", spoil_denormal_values}, {"huge values", spoil_huge_values},
    {"capacity", spoil_capacity}, {"alias", spoil_alias},
};
/* clang-format on */
enum { COLUMNS = sizeof columns / sizeof *columns };

/* ---------------------------------------------------------------- one cell */

static const struct {
    const char *name;
    int answer;
} errors[] = {{"NULL", SPH_ERROR_NULL},    {"DIM", SPH_ERROR_DIM},   {"KERNEL", SPH_ERROR_KERNEL},     {"COUNT", SPH_ERROR_COUNT},
              {"RANGE", SPH_ERROR_RANGE},  {"H", SPH_ERROR_H},       {"POSITION", SPH_ERROR_POSITION}, {"VALUE", SPH_ERROR_VALUE},
              {"LIST", SPH_ERROR_LIST},    {"SELF", SPH_ERROR_SELF}, {"CAPACITY", SPH_ERROR_CAPACITY}, {"BOX", SPH_ERROR_BOX},
              {"PAIRS", SPH_ERROR_PAIRS}};
enum { ERRORS = sizeof errors / sizeof *errors };

static const struct {
    const char *name;
    int answer;
} states[] = {{"ok", SPH_OK},
              {"TOO_FEW", SPH_TOO_FEW},
              {"SINGULAR", SPH_SINGULAR},
              {"ILL_CONDITIONED", SPH_ILL_CONDITIONED},
              {"FELL_BACK", SPH_FELL_BACK},
              {"NOT_AVAILABLE", SPH_NOT_AVAILABLE},
              {"NOT_FINITE", SPH_NOT_FINITE},
              {"LIST_TOO_SHORT", SPH_LIST_TOO_SHORT}};
enum { STATES = sizeof states / sizeof *states };

static const char *now_function = "", *now_column = "", *now_answer = "";
static int now_dim;
static void complain(const char *text, long got)
{
    fprintf(stderr, "test_contract.c: failed: %s, %s (%s) in %dD: %s; answered %ld, expected %s\n", now_function, now_column, what, now_dim, text, got,
            now_answer);
}
static void complain_refusal(const char *text, long answer)
{
    complain(text, answer);
    fprintf(stderr, "    said %d times: %s at particle %ld, error %d; expected %s at %ld\n", refusal.count,
            refusal.count ? refusal.argument : "", refusal.particle, refusal.error,
            blame.argument ? blame.argument : "any", blame.particle);
}
static void died(int sig)
{
    fprintf(stderr, "test_contract.c: signal %d: %s, %s (%s) in %dD\n", sig, now_function, now_column, what, now_dim);
    fprintf(stderr, "test_contract: %d passed, %d failed\n", check_passed, check_failed + 1);
    _Exit(3);
}

/* what a call may change of an array: from ... to */
static void free_region(const function *f, const world *w, int a, size_t *from, size_t *to)
{
    const sph_index *const start = index_of(&here->good, START);
    const size_t item = arrays[a].holds == REAL ? sizeof(sph_real) : arrays[a].holds == INDEX_ ? sizeof(sph_index) : 1;
    *from = 0;
    *to = here->size[a];
    if (a == WORK) *to = f->call == call_search ? w->block_size : w->work_size;
    else if ((a == I1 || a == R0) && f->has & OPAQUE) *to = (size_t)w->number[CAPACITY] * item;
    else if (f->has & OPAQUE || arrays[a].room == ROWS) return;
    else if (arrays[a].room == EACH && !(f->has & RAW)) *from = (size_t)w->first * item, *to = (size_t)w->last * item;
    else if (arrays[a].room == ROOM || arrays[a].room == PAIR) *from = (size_t)start[w->first] * item, *to = (size_t)start[w->last] * item;
}

/* Outputs: finite, written, 0 where there is no answer; status: as many failures as answered. */
static const char *judge_outputs(const function *f, const world *w, sph_index answer, int aliased)
{
    const uint64_t outputs = there(w->dim, f->writes | f->may_write);
    const unsigned char *const status = f->has & COUNTS || !(outputs & BIT(STATUS)) ? 0 : (const unsigned char *)w->a[STATUS];
    const uint64_t must_be_0 = f->has & PARTS ? 0 : outputs & (f->has & KEEPS ? BIT(S0) : ~NEED_NOT_BE_0);
    sph_real marked;
    sph_index i, p, failures = 0;
    int a;
    memset(&marked, MARK, sizeof marked);
    for (a = 0; a < ARRAYS; a++) {
        const sph_real *const at = real_of(w, a);
        size_t from, to, b;
        if (!(outputs & BIT(a)) || !at || arrays[a].holds != REAL) continue;
        free_region(f, w, a, &from, &to);
        for (b = from / sizeof *at; b < to / sizeof *at; b++) {
            if (!sphi_finite(at[b])) return "an output is not finite";
            if (!(f->has & OPAQUE) && !aliased && memcmp(&at[b], &marked, sizeof marked) == 0) return "an output is not written";
        }
    }
    if (status && !(f->has & OPAQUE)) {
        const sph_index *const start = index_of(w, START);
        for (i = w->first; i < w->last; i++) {
            if (status[i] > SPH_LIST_TOO_SHORT) return "no such status";
            failures += status[i] != SPH_OK;
            if (aliased || (status[i] != SPH_TOO_FEW && status[i] != SPH_SINGULAR && status[i] != SPH_NOT_AVAILABLE && status[i] != SPH_NOT_FINITE)) continue;
            for (a = 0; a < ARRAYS; a++) {
                const sph_real *const at = real_of(w, a);
                if (!(must_be_0 & BIT(a)) || !at || arrays[a].holds != REAL) continue;
                if (arrays[a].room == EACH && fabs((double)at[i]) > 0.0) return "an output is not 0 where there is no answer";
                for (p = start[i]; arrays[a].room == ROOM && p < start[i + 1]; p++)
                    if (fabs((double)at[p]) > 0.0) return "a row is not 0 where there is no answer";
            }
        }
        if (failures != answer) return "status and answer differ";
    }
    return 0;
}

static const char *judge(const function *f, const world *w, const char *expected, sph_index answer)
{
    const uint64_t outputs = f->writes | f->may_write;
    const int aliased = strcmp(now_column, "alias") == 0, none = strcmp(expected, "none") == 0, ok = strcmp(expected, "ok") == 0,
              some = strcmp(expected, "some") == 0, finite = strcmp(expected, "finite") == 0, zero = strcmp(expected, "0") == 0;
    const int grows = f->numbers & N(CAPACITY) || f->call == call_search;
    int a, e;
    for (e = 0; e < ERRORS && strcmp(errors[e].name, expected) != 0; e++) {}
    if (e == ERRORS && !none && !ok && !some && !finite && !zero) return "no such answer";
    if (e < ERRORS && answer != errors[e].answer) return "another answer";
    if ((none || zero) && answer != 0) return "another answer";
    if (e == ERRORS && answer < 0) return "an error";
    if (ok && answer > 0 && !(f->has & (COUNTS | SIZE))) return "some failed";
    if (some && answer == 0) return "nothing failed";
    if (e == ERRORS && !(f->has & SIZE) && answer > here->good.n) return "more failures than particles";
    if (f->has & SAYS && w->a[REPORT]) {
        const int64_t *const pairs = (const int64_t *)w->a[REPORT];
        if (e < ERRORS && errors[e].answer != SPH_ERROR_CAPACITY && *pairs != 0) return "a number of pairs beside an error";
        if (e == ERRORS && (*pairs < 0 || *pairs > (int64_t)here->good.n * here->good.n)) return "no such number of pairs";
        memcpy(here->before + ((unsigned char *)w->a[REPORT] - here->live), w->a[REPORT], f->call == call_search ? sizeof(sph_neighbors) : sizeof *pairs);
    }
    if ((e == ERRORS && !none) || (e < ERRORS && errors[e].answer == SPH_ERROR_CAPACITY && grows)) { /* take over what may have changed */
        const char *const wrong = e < ERRORS ? 0 : judge_outputs(f, w, answer, aliased);
        if (wrong) return wrong;
        for (a = 0; a < ARRAYS; a++) {
            size_t from, to;
            if (!(outputs & BIT(a)) || !w->a[a]) continue;
            free_region(f, w, a, &from, &to);
            memcpy(here->before + ((unsigned char *)w->a[a] - here->live) + from, (unsigned char *)w->a[a] + from, to - from);
        }
        if (e < ERRORS && *(const int64_t *)w->a[REPORT] != said) return "not the size that is needed";
    }
    if (memcmp(here->before, here->live, here->total) != 0) return e < ERRORS || none ? "something was written" : "something else was written";
    return 0;
}

/* Totals are given by every call that is not refused, and are 0 (the time step: not) where there is nothing. */
static const char *judge_totals(const function *f, const world *w, sph_index answer)
{
    const int nothing = f->has & TARGETS ? w->first == w->last : w->n == 0,
              is_step = f->call == call_rows_time_step;
    static const int totals[] = {S0, I0, REPORT};
    size_t k, b;
    if (!(f->has & TOTALS) || f->has & CHOOSES || answer < 0) return 0;
    for (k = 0; k < 3; k++) {
        const unsigned char *const at = (const unsigned char *)w->a[totals[k]];
        const size_t size = k == 0   ? (is_step ? 1 : 8) * sizeof(sph_real)
                            : k == 1 ? sizeof(sph_index)
                                     : sizeof(int64_t);
        int zero = 1, marked = 1;
        if (!at || !((f->writes | f->may_write) & BIT(totals[k]))) continue;
        for (b = 0; b < size; b++) zero &= at[b] == 0, marked &= at[b] == MARK;
        if (marked) return "a total is not given";
        if (nothing && zero == is_step) return "a total of nothing is wrong";
    }
    return 0;
}

/* What was answered, and why: an error and the argument that was refused (or the function, where the room was too
   small), or the status of a target and the function. */
enum { FACTS = 1024 };
static struct {
    int code, explained;
    char about[64];
} facts[FACTS];
static int facts_known;
static void fact_add(int code, const char *about)
{
    int i;
    for (i = 0; i < facts_known; i++)
        if (facts[i].code == code && strcmp(facts[i].about, about) == 0) return;
    if (!check_count(facts_known < FACTS)) return;
    facts[facts_known].code = code;
    snprintf(facts[facts_known++].about, sizeof facts->about, "%s", about);
}
static void facts_of_targets(const function *f, const world *w)
{
    const unsigned char *const status = (const unsigned char *)w->a[STATUS];
    sph_index i;
    if (!status || !((f->writes | f->may_write) & BIT(STATUS)) || f->has & COUNTS) return;
    for (i = w->first; i < w->last; i++) fact_add(status[i], f->name);
}

/* Once for each call that is refused, with its error, and never for another. That there is too little room is no
   refusal, but an answer. Of functions of sph.h only how often and with which error. */
static const char *judge_refusal(const function *f, sph_index answer)
{
    const int room = answer == SPH_ERROR_CAPACITY || answer == SPH_ERROR_PAIRS;
    const int fails = answer < 0 && !room && !(f->has & SIZE);
    if (refusal.count) fact_add(refusal.error, refusal.argument);
    else if (room) fact_add((int)answer, f->name);
    if (!fails) return refusal.count == 0 ? 0 : "SPH_REFUSED in a call that is not refused";
    if (refusal.count == 0) return "SPH_REFUSED is not called";
    if (refusal.count > 1) return "SPH_REFUSED is called more than once";
    if (refusal.error != answer) return "SPH_REFUSED with another error";
    if (!refusal.argument || !*refusal.argument) return "SPH_REFUSED without an argument";
    if (f->has & CALLER) return 0;
    if (blame.argument && strcmp(blame.argument, refusal.argument) != 0)
        return "SPH_REFUSED with another argument";
    if (blame.particle != -2 && blame.particle != refusal.particle)
        return "SPH_REFUSED with another particle";
    return 0;
}

/* Can the cloud of this call be marked? Where a function needs no positions or list they may not be there, or be
   wrong; and the sources of sph_nearest_distance are not those of its cloud. */
static int can_be_marked(const function *f, const world *w)
{
    const int boxed = w->box[0] != 0.0 || w->box[1] != 0.0 || w->box[2] != 0.0; /* a NaN, too */
    if (!(f->has & TARGETS) || f->call == call_nearest_distance) return 0;
    if (w->first == w->last) return 1;
    return w->a[PX] && w->a[START] && w->a[INDEX] && (!boxed || looks_at_box(f));
}
static const char *judge_marked(const function *f, const world *given, sph_index answer)
{
    world w = *given;
    sph_index again;
    if (!can_be_marked(f, given)) return 0;
    memcpy(here->after, here->live, here->total);
    memcpy(here->live, here->spoiled, here->total);
    w.marked = 1;
    refusal.count = 0;
    again = f->call(&w);
    if (again != answer) return "another answer with a checked cloud";
    if (memcmp(here->live, here->after, here->total) != 0) return "other results with a checked cloud";
    if (again < 0 && w.dim >= 1 && w.dim <= 3) return judge_refusal(f, again); /* both say a bad dimension */
    if (again < 0 || refusal.count == 0 || f->has & SIZE)
        return 0; /* a size has no errors, but the mark has */
    return "SPH_REFUSED in a call with a checked cloud that is not refused";
}

/* A stride of 0 counts as 1. The outputs as members of an array of structs, with a member that is none before,
   after and between them: the same numbers, and not a byte elsewhere. */
static const char *judge_strided(const function *f, const world *given, sph_index answer)
{
    const uint64_t outputs = there(given->dim, f->writes | f->may_write);
    const sph_index n = here->good.n;
    world w = *given;
    unsigned char *members;
    const char *wrong = 0;
    int a, slot = 1, width = 2;
    sph_index i;
    size_t b;
    if (f->has & (RAW | SIZE) || (f->has & OPAQUE && !(f->writes & BIT(VX)))) return 0;
    memcpy(here->after, here->live, here->total);
    memcpy(here->live, here->spoiled, here->total);
    w.out_stride = 0;
    if (f->call(&w) != answer) return "another answer with outputs of stride 0";
    if (memcmp(here->live, here->after, here->total) != 0) return "other results with outputs of stride 0";
    for (a = 0; a < ARRAYS; a++)
        if (outputs & BIT(a) && arrays[a].holds == REAL && arrays[a].room == EACH) width += 2;
    members = (unsigned char *)cloud_memory((size_t)n * (size_t)width, sizeof(sph_real));
    memset(members, MARK, (size_t)n * (size_t)width * sizeof(sph_real));
    memcpy(here->live, here->spoiled, here->total);
    w.out_stride = (size_t)width;
    for (a = 0; a < ARRAYS; a++) {
        if (!(outputs & BIT(a)) || arrays[a].holds != REAL || arrays[a].room != EACH) continue;
        for (i = 0; i < n; i++)
            memcpy((sph_real *)(void *)members + i * width + slot, real_of(given, a) + i, sizeof(sph_real));
        w.a[a] = (sph_real *)(void *)members + slot;
        slot += 2;
    }
    if (f->call(&w) != answer) wrong = "another answer with outputs in structs";
    for (a = 0; a < ARRAYS; a++) { /* back to where they belong, which leaves nothing but marks */
        if (w.a[a] == given->a[a]) continue;
        for (i = 0; i < n; i++) {
            memcpy(real_of(given, a) + i, real_of(&w, a) + i * width, sizeof(sph_real));
            memset(real_of(&w, a) + i * width, MARK, sizeof(sph_real));
        }
    }
    if (memcmp(here->live, here->after, here->total) != 0) wrong = "other results with outputs in structs";
    for (b = 0; b < (size_t)n * (size_t)width * sizeof(sph_real); b++)
        if (members[b] != MARK) wrong = "something between outputs in structs was written";
    free(members);
    return wrong;
}

/* Every way of a fault, in every dimension of the function. Returns how many there were. */
static int run_cell(const function *f, const struct column *c, const char *expected)
{
    int dim, v, ways = 0;
    now_function = f->name;
    now_column = c->name;
    now_answer = expected;
    for (dim = 1; dim <= 3; dim++) {
        if (!(f->dims & 1 << (dim - 1))) continue;
        here = &grounds[dim];
        now_dim = dim;
        for (v = 0;; v++) {
            world w = here->good;
            sph_index answer;
            int go;
            const char *wrong;
            what[0] = '\0';
            blame.argument = 0;
            blame.particle = -1;
            memcpy(here->live, here->good_bytes, here->total);
            go = c->spoil(f, &w, v);
            if (go == END) break;
            if (go == NOT_THIS) continue;
            ways++;
            if (strcmp(expected, "-") == 0) continue;
            memcpy(here->before, here->live, here->total);
            memcpy(here->spoiled, here->live, here->total);
            refusal.count = 0;
            asserted = 0;
            ground_guards(here, 1);
            answer = f->call(&w);
            ground_guards(here, 0);
            if (!check_count(!asserted || c->spoil == spoil_alias)) complain(asserted, (long)answer);
            wrong = judge(f, &w, expected, answer);
            if (!check_count(!wrong)) complain(wrong, (long)answer);
            wrong = judge_totals(f, &w, answer);
            if (!check_count(!wrong)) complain(wrong, (long)answer);
            wrong = judge_refusal(f, answer);
            if (!check_count(!wrong)) complain_refusal(wrong, (long)answer);
            if (answer >= 0) facts_of_targets(f, &w);
            wrong = judge_marked(f, &w, answer);
            if (!check_count(!wrong)) complain(wrong, (long)answer);
            if (c->spoil != spoil_nothing) continue;
            memcpy(here->live, here->spoiled, here->total);
            (void)f->call(&w); /* after judge_marked */
            wrong = judge_strided(f, &w, answer);
            if (!check_count(!wrong)) complain(wrong, (long)answer);
        }
    }
    return ways;
}

/* ---------------------------------------------------------------- the tables */

enum { LINE = 1024, CELLS = 24 };
static unsigned char seen[FUNCTIONS][COLUMNS];

static void problem(const char *text, const char *name)
{
    check_count(0);
    fprintf(stderr, "test_contract.c: failed: %s: %s\n", text, name);
}
/* cells of a line, without blanks and code quotes */
static int split(char *line, char *cell[CELLS])
{
    int n = 0;
    char *next = strchr(line, '|');
    while (next && n < CELLS) {
        char *const from = next + 1 + strspn(next + 1, " `");
        char *end = next = strchr(next + 1, '|');
        if (!next) break;
        *next = '\0';
        while (end > from && (end[-1] == ' ' || end[-1] == '`')) end--;
        *end = '\0';
        cell[n++] = from;
        *next = '\0';
    }
    return n;
}
/* A row of the causes: what it says stands in the text of its error or status, and some facts are explained. */
static void test_cause(char *cell[CELLS], int n)
{
    char *about, *next;
    int i, code = -1000, used = 0;
    if (n != 4) {
        problem("a cause with missing cells", cell[0]);
        return;
    }
    for (i = 0; i < ERRORS; i++)
        if (strcmp(errors[i].name, cell[0]) == 0) code = errors[i].answer;
    for (i = 0; i < STATES; i++)
        if (strcmp(states[i].name, cell[0]) == 0) code = states[i].answer;
    if (!strstr(sph_status_text(code), cell[1])) problem("words that are not in the text of the code", cell[1]);
    for (about = cell[2]; about && *about; about = next) {
        next = strstr(about, "; ");
        if (next) *next = '\0', next += 2;
        for (i = 0; i < facts_known; i++)
            if (facts[i].code == code && (about[strlen(about) - 1] == '*'
                                              ? strncmp(facts[i].about, about, strlen(about) - 1) == 0
                                              : strcmp(facts[i].about, about) == 0))
                facts[i].explained = used = 1;
    }
    if (SPH_CHECK && !used && strncmp(cell[3], "elsewhere", 9) != 0) problem("a cause that was never met", cell[1]);
}
static void test_causes(const char *path)
{
    FILE *const file = fopen(path, "r");
    char line[LINE], *cell[CELLS];
    int i, causes = 0;
    while (file && fgets(line, sizeof line, file)) {
        if (line[0] != '|' || line[2] == '-') {
            if (line[0] != '|') causes = 0;
            continue;
        }
        i = split(line, cell);
        if (causes) test_cause(cell, i);
        else causes = strcmp(cell[0], "code") == 0;
    }
    if (file) fclose(file);
    for (i = 0; i < facts_known; i++)
        if (!check_count(facts[i].explained))
            fprintf(stderr, "test_contract.c: failed: no cause of %d (%s): %s\n", facts[i].code,
                    sph_status_text(facts[i].code), facts[i].about);
}
static int column_of(const char *name)
{
    int c;
    for (c = 0; c < COLUMNS && strcmp(columns[c].name, name) != 0; c++) {}
    return c;
}
static int function_of(const char *name)
{
    int i;
    for (i = 0; i < FUNCTIONS && strcmp(functions[i].name, name) != 0; i++) {}
    return i;
}
static void test_tables(const char *path)
{
    FILE *const file = fopen(path, "r");
    char line[LINE], *cell[CELLS];
    int head[CELLS], width = 0, contents = 0, i, f, ways;
    if (!file) {
        problem("cannot read", path);
        return;
    }
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#') contents = strstr(line, "Contents") != 0;
        if (line[0] != '|') {
            width = 0;
            continue;
        }
        if (line[2] == '-') continue; /* the rule under the head */
        i = split(line, cell);
        if (width == 0) {
            width = strcmp(cell[0], "function") == 0 ? i : -1;
            for (i = 1; i < width; i++)
                if ((head[i] = column_of(cell[i])) == COLUMNS) problem("a column without a fault", cell[i]);
            continue;
        }
        if (width < 0) continue; /* another kind of table */
        f = function_of(cell[0]);
        if (i != width) problem("a row that is not as long as its head", cell[0]);
        else if (f == FUNCTIONS) problem("a row without a function", cell[0]);
        else
            for (i = 1; i < width; i++) {
                char *other = strchr(cell[i], '/'); /* in float */
                if (head[i] == COLUMNS) continue;
                if (other) *other++ = '\0';
                if (seen[f][head[i]]++) problem("a cell twice", cell[0]);
                if (contents && !SPH_CHECK) continue;
                ways = run_cell(&functions[f], &columns[head[i]], SPH_SINGLE && other ? other : cell[i]);
                if ((ways > 0) != (strcmp(cell[i], "-") != 0)) {
                    check_count(0);
                    fprintf(stderr, "test_contract.c: failed: %s, %s: '%s', but the fault has %d ways\n", functions[f].name, columns[head[i]].name, cell[i],
                            ways);
                }
            }
    }
    fclose(file);
    for (f = 0; f < FUNCTIONS; f++)
        for (i = 0; i < COLUMNS; i++)
            if (!check_count(seen[f][i] == 1)) fprintf(stderr, "test_contract.c: failed: no cell for %s, %s\n", functions[f].name, columns[i].name);
}

/* Every public function of a header that takes arrays (points, lists, grids, orders), or says how large they must be, is in `functions`: SPH_FN at the start of a line. */
static void test_complete(const char *path)
{
    static const char *const takes[] = {"sph_points ", "sph_cloud ", "sph_list ", "sph_grid *", "sph_index *", "_workspace(", "_size("};
    FILE *const file = fopen(path, "r");
    char text[4 * LINE], name[LINE], *from, *end;
    size_t i;
    int found = 0;
    if (!file) {
        problem("cannot read", path);
        return;
    }
    while (fgets(text, LINE, file)) {
        if (strncmp(text, "SPH_FN ", 7) != 0) continue;
        while (!strchr(text, ')') && strlen(text) < 3 * LINE && fgets(text + strlen(text), LINE, file)) {}
        end = strchr(text, '(');
        if (!end) continue;
        for (from = end; from > text && from[-1] != ' ' && from[-1] != '*'; from--) {}
        snprintf(name, sizeof name, "%.*s", (int)(end - from), from);
        if (strcmp(name, "sph_cloud_examine") == 0) continue; /* tests/test_doctor.c has its answers */
        if (strncmp(name, "sph_", 4) != 0 || strncmp(text, "SPH_FN sph_points ", 18) == 0 || strncmp(text, "SPH_FN sph_cloud ", 17) == 0) continue;
        if (strncmp(text, "SPH_FN sph_query ", 17) == 0) continue;
        *strchr(end, ')') = '\0';
        for (i = 0; i < sizeof takes / sizeof *takes && !strstr(from, takes[i]); i++) {}
        if (i == sizeof takes / sizeof *takes) continue;
        found++;
        if (!check_count(function_of(name) < FUNCTIONS)) fprintf(stderr, "test_contract.c: failed: %s of %s is not in the contract\n", name, path);
    }
    fclose(file);
    if (strcmp(path, "sph_kernels.h") != 0) CHECK(found > 0);
}

/* ---------------------------------------------------------------- what only targets have */

/* The first half of the particles as targets, of sources of which the others have this array times a factor.
   Returns the answer; the outputs of the targets are in here->live. */
static sph_index call_with_sources(const function *f, int option, int a, double factor)
{
    world w = here->good;
    sph_index i;
    memcpy(here->live, here->good_bytes, here->total);
    w.last = w.n / 2;
    if (f->numbers & N(VISCOSITY)) w.number[VISCOSITY] = option; /* what is read may depend on it */
    for (i = w.last; i < w.n && a >= 0; i++) real_of(&w, a)[i] *= SPH_R(factor);
    refusal.count = 0;
    return f->call(&w);
}
/* Is this array one of what only targets have? Where the values of sources change a bit of an answer a NaN there
   must be refused; else it must not be refused, nor change a bit. */
static void test_sources(const function *f, int a)
{
    static const double factor[] = {1.25, -1.0, 0.0};
    const unsigned char *const given = here->good_bytes + here->offset[a];
    /* only whether the sum of two is 0 counts; and rho is what the rows are for */
    const int hidden = (f->call == call_collision_count && a == INVERSE_M) || (f->call == call_density_diffusion_rows_molteni && a == RHO);
    int option, k, read = hidden, refused = 0, same = 1;
    now_function = f->name;
    now_dim = here->good.dim;
    for (option = 0; option <= (f->numbers & N(VISCOSITY) ? 3 : 0); option++) {
        (void)call_with_sources(f, option, -1, 1.0);
        memcpy(here->after, here->live, here->total);
        for (k = 0; k < 4; k++) {
            const sph_index answer = call_with_sources(f, option, a, k < 3 ? factor[k] : (double)NAN);
            memcpy(here->live + here->offset[a], given, here->size[a]); /* only outputs are compared */
            if (k < 3) read |= memcmp(here->live, here->after, here->total) != 0;
            else same &= memcmp(here->live, here->after, here->total) == 0;
            if (k == 3) refused |= answer < 0;
        }
    }
    snprintf(what, sizeof what, "%s of what is no target", arrays[a].name);
    if (SPH_CHECK && !check_count(read == refused)) complain(read ? "a NaN of a source is not refused" : "refused, but nothing reads it", 0);
    if (!read && !check_count(same)) complain("a NaN that nothing reads changes the answer", 0);
}
static void test_targets_only(void)
{
    int i, a, found = 0;
    now_column = "targets only";
    now_answer = "the same bits";
    for (i = 0; i < FUNCTIONS; i++) {
        const function *const f = &functions[i];
        uint64_t set;
        here = &grounds[f->dims & 2 ? 2 : f->dims & 4 ? 3 : 1];
        if (!(f->has & TARGETS) || !(f->has & COUNTED) || f->has & (ONE_ROW | RAW)) continue;
        /* volumes, h and positions are a cloud's own, of all */
        set = (values_of(f, &here->good) | (inputs_of(f, &here->good) & BIT(REACH))) & ~(f->writes | BIT(V) | BIT(ROW));
        for (a = 0; a < ARRAYS; a++)
            if (set & BIT(a)) test_sources(f, a), found++;
    }
    CHECK(found > 200);
}

int main(void)
{
    static const int side[4] = {0, 24, 5, 3};
    int dim;
    signal(SIGSEGV, died);
    signal(SIGFPE, died);
    signal(SIGABRT, died);
#if defined(SIGALRM)
    signal(SIGALRM, died);
#endif
    WATCH(240); /* a function that never ends */
    for (dim = 1; dim <= 3; dim++) grounds[dim] = ground_new(dim, side[dim]);
    test_complete("sph_kernels.h");
    test_complete("sph_ops.h");
    test_complete("sph.h");
    test_targets_only();
    test_tables("tests/CONTRACT.md");
    test_causes("tests/CONTRACT.md");
    for (dim = 1; dim <= 3; dim++) ground_free(&grounds[dim]);
    return check_report(SPH_CHECK ? "test_contract" : "test_contract_unchecked");
}
