/* SPDX-License-Identifier: MIT
 *
 * collapse.h - self-gravitating magnetised gas in a periodic box, with a sink particle: the host code of the benchmark in section IV-C of the paper on divergence cleaning (Tricco & Price 2012).
 *
 * The operators are those of the headers; tree, steps, sink and restart are the host's: tree.h, collapse_sink.h and this file. Units: G = 1, mu_0 = 1; the rest is the caller's.
 * Gas: m the same for all; density and h by sph_density_adaptive, sph_mhd_rates, gravity softened by the kernel with the term of an h that follows the density. The hydrodynamics is periodic, gravity is
 * isolated. Steps: one for all, leapfrog with one evaluation of the rates, everything but positions predicted by Euler's rule and corrected by the trapezoidal one.
 * Particles are stored in the order of the tree, which changes with every step: ID says who is who.
 * A function that may find trouble (not finite, too fast, no density) answers 0 or writes down why, in `trouble`, and answers 1; collapse_step then leaves the gas as it was before the step.
 */
#ifndef COLLAPSE_H
#define COLLAPSE_H

#include <stdarg.h>
#include <time.h>

#include "../common/restart.h"
#include "../common/tree.h"
#include "collapse_sink.h"

#define COLLAPSE_KERNEL SPH_CUBIC_SPLINE
#define COLLAPSE_ETA 1.2
#define COLLAPSE_TOLERANCE 1e-4 /* of h */
#define COLLAPSE_GROWTH 1.04    /* of h, that lists allow for */

/* The numbers of a run that never change. A restart file is good for the same numbers only. */
typedef struct collapse_model {
    double m, box; /* of a particle; period of all three axes, 0: open */
    double cs, medium_cs, rho1,
        rho2; /* sound speeds of the cold cloud and of the medium; densities above which the cloud heats up: collapse_pressure */
    double courant, shortest; /* time step over its limit; a shorter one than that ends the run */
    double fastest;           /* so does a faster signal */
    double theta;             /* of the tree; 0: direct summation */
    double alpha_B; /* resistivity; with `switches` the most of it: alpha_B min(1, h |curl B| / |B|) */
    double alpha_min, alpha_max, sigma, tensile;
    double radius, rho_sink;            /* of the sink; rho_sink 0: never */
    int cleans, zeta, switches, unused; /* a restart compares all bytes: no gaps */
} collapse_model;

/* what evolves, with a rate each; what goes with the particle; what follows from them */
enum { VX, VY, VZ, BX, BY, BZ, PSI, ALPHA, EVOLVED };
enum { X = EVOLVED, Y, Z, H, ID, MEDIUM, KEPT };
enum { RHO = KEPT, OMEGA, P, CS, SPEED, DIV_V, DIV_B, ALPHA_B, ZETA, GX, GY, GZ, REACH, SX, SY, SZ, ARRAYS };
static const char *const collapse_evolved[EVOLVED] = {"vx", "vy", "vz", "Bx", "By", "Bz", "psi", "alpha"};

/* Everything else that a restart needs: plain numbers */
typedef struct collapse_state {
    double t, ch, cpu;
    long steps;
    sph_index n;
    sink core;
    char objection[64]; /* why there is no sink yet although a particle is dense enough; empty: none is */
    /* net forces on all of it, and their impulses so far: of gravity (the tree's error), and of the rest (all of it (9)) */
    double force_gravity[3], force_field[3], impulse_gravity[3], impulse_field[3];
    double error, error_cloud,
        ratio; /* mean h |div B| / |B| of all and of the cloud's particles; <h |div B|> / <|B|> */
    double densest, fastest;
} collapse_state;

typedef struct collapse {
    collapse_model model;
    collapse_state s;
    sph_index room;
    double *a[ARRAYS], *rate[EVOLVED], *before[EVOLVED], *spare, *block, *backup;
    unsigned char *status;
    tree tree;
    tree_rows rows;
    char trouble[192];
} collapse;

static inline int collapse_trouble(collapse *g, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(g->trouble, sizeof g->trouble, format, values);
    va_end(values);
    return 1;
}

static inline void collapse_new(collapse *g, const collapse_model *model, sph_index n)
{
    const size_t count = (size_t)n, arrays = ARRAYS + 2 * EVOLVED + 1;
    int k;
    memset(g, 0, sizeof *g);
    g->model = *model;
    g->s.n = g->room = n;
    g->block = (double *)need(NULL, arrays * count, sizeof(double));
    memset(g->block, 0, arrays * count * sizeof(double));
    g->backup = (double *)need(NULL, (ARRAYS + EVOLVED) * count, sizeof(double));
    for (k = 0; k < ARRAYS; k++) g->a[k] = g->block + (size_t)k * count;
    for (k = 0; k < EVOLVED; k++) {
        g->rate[k] = g->block + (size_t)(ARRAYS + k) * count;
        g->before[k] = g->block + (size_t)(ARRAYS + EVOLVED + k) * count;
    }
    g->spare = g->block + (arrays - 1) * count;
    g->status = (unsigned char *)need(NULL, count, 1);
}
static inline void collapse_free(collapse *g)
{
    free(g->block);
    free(g->backup);
    free(g->status);
    tree_free(&g->tree);
    tree_rows_free(&g->rows);
}

/* ---- views ---- */

static inline sph_scalars collapse_field(const collapse *g, int which)
{
    return sph_scalars_array(g->a[which]);
}
static inline sph_points collapse_open(const collapse *g)
{
    return sph_points_separate(g->s.n, g->a[X], g->a[Y], g->a[Z]);
}
static inline sph_points collapse_points(const collapse *g)
{
    return sph_points_periodic(collapse_open(g), g->model.box, g->model.box, g->model.box);
}
static inline sph_list collapse_list(const collapse *g)
{
    sph_list l;
    l.start = g->rows.start;
    l.index = g->rows.index;
    return l;
}
static inline sph_cloud collapse_cloud(const collapse *g, sph_index first, sph_index last)
{
    return sph_cloud_range(
        sph_cloud_of(collapse_points(g), collapse_list(g), collapse_field(g, H), sph_scalars_none()), first,
        last);
}
/* for gravity, which knows of no box */
static inline sph_cloud collapse_isolated(const collapse *g, sph_index first, sph_index last)
{
    sph_cloud cloud = collapse_cloud(g, first, last);
    cloud.points = collapse_open(g);
    return cloud;
}
static inline sph_medium collapse_gas(const collapse *g)
{
    sph_medium s;
    s.m = sph_scalars_same(&g->model.m);
    s.rho = collapse_field(g, RHO);
    s.omega = collapse_field(g, OMEGA);
    return s;
}
static inline sph_mhd collapse_mhd(const collapse *g)
{
    static const double none =
        0; /* the pressure is a function of the density: no thermal energy evolves, and none is conducted */
    sph_mhd s;
    s.medium = collapse_gas(g);
    s.p = collapse_field(g, P);
    s.u = sph_scalars_same(&none);
    s.cs = collapse_field(g, CS);
    s.alpha = collapse_field(g, ALPHA);
    s.alpha_B = g->model.switches ? collapse_field(g, ALPHA_B) : sph_scalars_same(&g->model.alpha_B);
    s.v = vectors_of(g->a + VX, 3);
    s.field = vectors_of(g->a + BX, 3);
    s.psi = sph_scalars_array(g->model.cleans ? g->a[PSI] : NULL);
    s.ch = g->s.ch;
    s.sigma = g->model.sigma;
    s.beta = 2;
    s.alpha_u = 0;
    s.tensile = g->model.tensile;
    return s;
}

static inline void collapse_vector_of(double *const *a, int which, sph_index i, double *v)
{
    int c;
    for (c = 0; c < 3; c++) v[c] = a[which + c][i];
}
static inline double collapse_length(const double *v)
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}
static inline double collapse_length_of(double *const *a, int which, sph_index i)
{
    double v[3];
    collapse_vector_of(a, which, i, v);
    return collapse_length(v);
}

/* Sweeps over ranges of the gas, which threads share */
typedef sph_index (*collapse_sweep)(collapse *g, sph_index first, sph_index last);
typedef struct collapse_job {
    collapse_sweep work;
    collapse *g;
} collapse_job;
static inline long collapse_part(void *data, long first, long last)
{
    const collapse_job *const job = (const collapse_job *)data;
    return job->work(job->g, (sph_index)first, (sph_index)last);
}
static inline sph_index collapse_everywhere(collapse_sweep work, collapse *g, sph_index n)
{
    collapse_job job;
    job.work = work;
    job.g = g;
    return (sph_index)threads_each(n, collapse_part, &job);
}
static inline int collapse_expect(collapse *g, sph_index answer, const char *operation)
{
    if (answer != 0) return collapse_trouble(g, "%s: %s", operation, answer_text(answer));
    return 0;
}

/* ---- order, lists, density ---- */

static inline void collapse_permute(collapse *g, double **p)
{
    double *const old = *p;
    (void)sph_permute(g->s.n, g->tree.order, old, 1, g->spare);
    *p = g->spare;
    g->spare = old;
}
/* into the box, and into the order of a new tree */
static inline int collapse_sort(collapse *g)
{
    const double L = g->model.box;
    sph_index i;
    int c, k;
    for (c = 0; c < 3; c++)
        for (i = 0; i < g->s.n; i++) {
            if (!isfinite(g->a[X + c][i]))
                return collapse_trouble(g, "%c of particle %ld is %g", 'x' + c, (long)g->a[ID][i],
                                        g->a[X + c][i]);
            if (L > 0) g->a[X + c][i] -= L * floor(g->a[X + c][i] / L + 0.5);
        }
    tree_order(&g->tree, g->s.n, g->a[X], g->a[Y], g->a[Z]);
    for (k = 0; k < KEPT; k++) collapse_permute(g, &g->a[k]);
    for (k = 0; k < EVOLVED; k++) collapse_permute(g, &g->before[k]);
    return 0;
}

static inline sph_index collapse_density_sweep(collapse *g, sph_index first, sph_index last)
{
    const sph_density_options options = {collapse_field(g, REACH), COLLAPSE_ETA, COLLAPSE_TOLERANCE};
    const sph_density_out out = {.h = g->a[H], .rho = g->a[RHO], .omega = g->a[OMEGA], .status = g->status};
    return sph_density_adaptive(COLLAPSE_KERNEL, 3, collapse_cloud(g, first, last),
                                sph_scalars_same(&g->model.m), options, out);
}
static inline int collapse_density(collapse *g)
{
    const double support = sph_kernel_support_ratio(COLLAPSE_KERNEL),
                 longest = g->model.box > 0 ? 0.4999 * g->model.box : HUGE_VAL;
    int again = 1;
    while (again) {
        sph_index i, answer;
        for (i = 0; i < g->s.n; i++) {
            if (!(g->a[H][i] > 0 && isfinite(g->a[H][i])))
                return collapse_trouble(g, "h of particle %ld is %g", (long)g->a[ID][i], g->a[H][i]);
            g->a[REACH][i] = fmin(COLLAPSE_GROWTH * support * g->a[H][i], longest);
        }
        tree_reach(&g->tree, g->a[REACH]);
        tree_neighbours(&g->tree, g->a[X], g->a[Y], g->a[Z], g->a[REACH], g->model.box, &g->rows);
        answer = collapse_everywhere(collapse_density_sweep, g, g->s.n);
        if (answer < 0) return collapse_expect(g, answer, "sph_density_adaptive");
        again = 0;
        for (i = 0; i < g->s.n && answer > 0; i++) {
            if (g->status[i] == SPH_OK) continue;
            if (g->status[i] != SPH_LIST_TOO_SHORT)
                return collapse_trouble(g, "density of particle %ld: %s", (long)g->a[ID][i],
                                        sph_status_text(g->status[i]));
            if (g->a[REACH][i] < longest) again = 1;
            else g->a[H][i] = longest / support; /* a void: as far as the box allows */
        }
    }
    return 0;
}

/* ---- state, rates ---- */

/* P = cs^2 rho up to rho1, cs^2 rho (rho / rho1)^0.4 up to rho2, and (rho / rho2)^0.1 times what that is there; Bate, Bonnell & Bromm 2003, MNRAS 339, 577 (gamma = 1.4), with gamma = 1.1 where molecules
   break up. The medium is isothermal. sound: sqrt(dP/drho). */
static inline double collapse_pressure(const collapse_model *model, int medium, double rho, double *sound)
{
    double gamma = 1, P_over_rho = medium ? model->medium_cs * model->medium_cs : model->cs * model->cs;
    if (!medium && rho > model->rho1) {
        gamma = rho > model->rho2 ? 1.1 : 1.4;
        P_over_rho *= pow(fmin(rho, model->rho2) / model->rho1, 0.4);
        if (rho > model->rho2) P_over_rho *= pow(rho / model->rho2, 0.1);
    }
    *sound = sqrt(gamma * P_over_rho);
    return P_over_rho * rho;
}
/* what follows from rho and B */
static inline void collapse_equation_of_state(collapse *g)
{
    double fastest = 0;
    sph_index i;
    g->s.densest = 0;
    for (i = 0; i < g->s.n; i++) {
        const double B2 = g->a[BX][i] * g->a[BX][i] + g->a[BY][i] * g->a[BY][i] + g->a[BZ][i] * g->a[BZ][i],
                     rho = g->a[RHO][i];
        g->a[P][i] = collapse_pressure(&g->model, g->a[MEDIUM][i] > 0, rho, &g->a[CS][i]);
        fastest = fmax(fastest, g->a[CS][i] * g->a[CS][i] + B2 / rho);
        g->s.densest = fmax(g->s.densest, rho);
    }
    g->s.ch = sqrt(fastest);
}

static inline sph_index collapse_tree_sweep(collapse *g, sph_index first, sph_index last)
{
    tree_gravity(COLLAPSE_KERNEL, &g->tree, (int)first, (int)last, g->model.theta, g->a[X], g->a[Y], g->a[Z],
                 g->spare, g->a[H], 1, collapse_list(g), g->a[GX], g->a[GY], g->a[GZ]);
    return 0;
}
static inline sph_index collapse_direct_sweep(collapse *g, sph_index first, sph_index last)
{
    return sph_gravity_direct(COLLAPSE_KERNEL, collapse_isolated(g, first, last),
                              sph_scalars_same(&g->model.m), 1, vectors_into(g->a + GX, 3),
                              sph_scalar_out_array(NULL, 0));
}
/* Neighbours across the edge of the box count in the density, and so in the correction; they are no neighbours for gravity, which is isolated: zeta takes the open distances. */
static inline sph_index collapse_zeta_sweep(collapse *g, sph_index first, sph_index last)
{
    return sph_gravity_zeta(COLLAPSE_KERNEL, collapse_isolated(g, first, last), sph_scalars_same(&g->model.m),
                            collapse_field(g, RHO), sph_scalar_out_array(g->a[ZETA], 0));
}
static inline sph_index collapse_correction_sweep(collapse *g, sph_index first, sph_index last)
{
    return sph_gravity_correction(COLLAPSE_KERNEL, collapse_cloud(g, first, last), collapse_gas(g),
                                  collapse_field(g, ZETA), 1, vectors_into(g->a + SX, 3));
}
/* the curl, in the place of the rate of B that comes after it */
static inline sph_index collapse_resistivity_sweep(collapse *g, sph_index first, sph_index last)
{
    const sph_index failed =
        sph_curl_difference(COLLAPSE_KERNEL, 3, collapse_cloud(g, first, last), collapse_gas(g),
                            vectors_of(g->a + BX, 3), vectors_into(g->rate + BX, 3));
    sph_index i;
    for (i = first; i < last; i++)
        g->a[ALPHA_B][i] =
            g->model.alpha_B * sph_resistivity_switch(g->a[H][i], collapse_length_of(g->rate, BX, i),
                                                      collapse_length_of(g->a, BX, i));
    return failed;
}
static inline sph_index collapse_rates_sweep(collapse *g, sph_index first, sph_index last)
{
    sph_mhd_out out = {0};
    out.acceleration = vectors_into(g->rate + VX, 3);
    out.rate_B = vectors_into(g->rate + BX, 3);
    out.rate_u = NULL;
    out.rate_psi = g->rate[PSI];
    out.div_B = g->a[DIV_B];
    out.div_v = g->a[DIV_V];
    out.v_sig = g->a[SPEED];
    return sph_mhd_rates(COLLAPSE_KERNEL, 3, collapse_cloud(g, first, last), collapse_mhd(g), out);
}
static inline int collapse_gravity(collapse *g)
{
    const double support = sph_kernel_support_ratio(COLLAPSE_KERNEL);
    sph_index i;
    if (g->model.theta > 0) {
        for (i = 0; i < g->s.n; i++) {
            g->a[REACH][i] = support * g->a[H][i];
            g->spare[i] = g->model.m;
        }
        tree_reach(&g->tree, g->a[REACH]);
        tree_moments(&g->tree, g->a[X], g->a[Y], g->a[Z], g->spare);
        collapse_everywhere(collapse_tree_sweep, g, g->tree.leaves);
    } else if (collapse_expect(g, collapse_everywhere(collapse_direct_sweep, g, g->s.n),
                               "sph_gravity_direct"))
        return 1;
    if (g->model.zeta) {
        if (collapse_expect(g, collapse_everywhere(collapse_zeta_sweep, g, g->s.n), "sph_gravity_zeta"))
            return 1;
        if (collapse_expect(g, collapse_everywhere(collapse_correction_sweep, g, g->s.n),
                            "sph_gravity_correction"))
            return 1;
    }
    return 0;
}
/* The sink pulls gas and gas the sink: Newton beyond its radius, softened by the kernel within. */
static inline void collapse_sink_gravity(collapse *g)
{
    sink *const core = &g->s.core;
    const double h = core->radius / sph_kernel_support_ratio(COLLAPSE_KERNEL);
    sph_index i;
    int c;
    for (c = 0; c < 3; c++) core->a[c] = 0;
    for (i = 0; i < g->s.n && core->m > 0; i++) {
        double d[3], r2 = 0, f;
        for (c = 0; c < 3; c++) {
            d[c] = g->a[X + c][i] - core->x[c];
            r2 += d[c] * d[c];
        }
        f = sph_gravity_force(COLLAPSE_KERNEL, sqrt(r2), h);
        for (c = 0; c < 3; c++) {
            g->a[GX + c][i] -= core->m * f * d[c];
            core->a[c] += g->model.m * f * d[c];
        }
    }
}

/* The errors of the field, as the rates have seen it */
static inline void collapse_errors(collapse *g)
{
    double cloud = 0, h_div_B = 0, sum_B = 0;
    sph_index i;
    g->s.error = g->s.error_cloud = 0;
    for (i = 0; i < g->s.n; i++) {
        const double B = collapse_length_of(g->a, BX, i), e = g->a[H][i] * fabs(g->a[DIV_B][i]);
        g->s.error += e / B;
        if (!(g->a[MEDIUM][i] > 0)) {
            g->s.error_cloud += e / B;
            cloud += 1;
        }
        h_div_B += e;
        sum_B += B;
    }
    g->s.error /= g->s.n;
    g->s.error_cloud /= fmax(cloud, 1);
    g->s.ratio = h_div_B / sum_B;
}

/* Everything at the present positions, from h as a guess. */
static inline int collapse_rates(collapse *g)
{
    sph_index i;
    int c;
    if (collapse_sort(g) || collapse_density(g)) return 1;
    collapse_equation_of_state(g);
    if (collapse_gravity(g)) return 1;
    if (g->model.switches &&
        collapse_expect(g, collapse_everywhere(collapse_resistivity_sweep, g, g->s.n), "sph_curl_difference"))
        return 1;
    if (collapse_expect(g, collapse_everywhere(collapse_rates_sweep, g, g->s.n), "sph_mhd_rates")) return 1;
    collapse_sink_gravity(g);
    collapse_errors(g);
    g->s.fastest = 0;
    for (c = 0; c < 3; c++) {
        g->s.force_gravity[c] = g->s.core.m * g->s.core.a[c];
        g->s.force_field[c] = 0;
    }
    for (i = 0; i < g->s.n; i++) {
        const sph_switch alpha = {g->a[ALPHA][i], g->model.alpha_min, g->model.alpha_max};
        for (c = 0; c < 3; c++) {
            g->s.force_gravity[c] += g->model.m * g->a[GX + c][i];
            if (g->model.zeta) g->rate[VX + c][i] += g->a[SX + c][i];
            g->s.force_field[c] += g->model.m * g->rate[VX + c][i];
            g->rate[VX + c][i] += g->a[GX + c][i];
        }
        g->rate[ALPHA][i] = sph_viscosity_switch_rate(alpha, g->a[SPEED][i], g->a[H][i], g->a[DIV_V][i]);
        g->s.fastest = fmax(g->s.fastest, g->a[SPEED][i]);
    }
    return 0;
}

/* ---- steps ---- */

/* courant min(h / v_sig, h / ch, 0.8 sqrt(h / |a|)); shortest: whose it is */
static inline double collapse_longest_step(const collapse *g, sph_index *shortest)
{
    double dt = HUGE_VAL;
    sph_index i;
    *shortest = 0;
    for (i = 0; i < g->s.n; i++) {
        const double speed = g->model.cleans ? fmax(g->a[SPEED][i], g->s.ch) : g->a[SPEED][i];
        const double own =
            fmin(g->a[H][i] / speed, 0.8 * sqrt(g->a[H][i] / collapse_length_of(g->rate, VX, i)));
        if (own < dt) {
            dt = own;
            *shortest = i;
        }
    }
    return g->model.courant * dt;
}

/* ---- the sink ---- */

/* Gas whose ID is negative becomes part of the sink, and what stays moves up, in its order. */
static inline void collapse_swallow(collapse *g)
{
    sph_index i, kept = 0;
    int k;
    for (i = 0; i < g->s.n; i++) {
        if (g->a[ID][i] < 0) {
            double x[3], v[3], a[3];
            collapse_vector_of(g->a, X, i, x);
            collapse_vector_of(g->a, VX, i, v);
            collapse_vector_of(g->rate, VX, i, a);
            sink_absorb(&g->s.core, g->model.m, x, v, a);
            continue;
        }
        for (k = 0; k < ARRAYS; k++) g->a[k][kept] = g->a[k][i];
        for (k = 0; k < EVOLVED; k++) g->rate[k][kept] = g->rate[k][i];
        kept++;
    }
    g->s.n = kept;
}
static inline void collapse_mark(collapse *g, sph_index i) { g->a[ID][i] = -1 - g->a[ID][i]; }

/* The gas within the radius of a sink about the densest particle */
static inline sink_clump collapse_clump(const collapse *g, sph_index densest, sph_index *member,
                                        sph_index *members)
{
    const double reach = sph_kernel_support_ratio(COLLAPSE_KERNEL) * g->a[H][densest],
                 radius = fmax(reach, g->model.radius);
    double x[3] = {0, 0, 0}, v[3] = {0, 0, 0}, spin[3] = {0, 0, 0}, axis;
    sink_clump clump;
    sph_index i, j, k, l;
    int c;
    memset(&clump, 0, sizeof clump);
    clump.div_v = g->a[DIV_V][densest];
    clump.reach = reach;
    *members = 0;
    for (j = 0; j < g->s.n; j++) {
        double r2 = 0;
        for (c = 0; c < 3; c++) r2 += pow(g->a[X + c][j] - g->a[X + c][densest], 2);
        if (r2 < radius * radius) member[(*members)++] = j;
    }
    for (k = 0; k < *members; k++)
        for (c = 0; c < 3; c++) {
            x[c] += g->a[X + c][member[k]] / *members;
            v[c] += g->a[VX + c][member[k]] / *members;
        }
    for (k = 0; k < *members; k++) {
        double d[3], w[3], turn[3];
        for (c = 0; c < 3; c++) {
            d[c] = g->a[X + c][member[k]] - x[c];
            w[c] = g->a[VX + c][member[k]] - v[c];
        }
        sink_cross(d, w, turn);
        for (c = 0; c < 3; c++) spin[c] += turn[c];
    }
    axis = sqrt(spin[0] * spin[0] + spin[1] * spin[1] + spin[2] * spin[2]) + 1e-300;
    for (k = 0; k < *members; k++) {
        double d[3], w[3], turn[3], d2 = 0, along = 0, turning = 0;
        i = member[k];
        for (c = 0; c < 3; c++) {
            d[c] = g->a[X + c][i] - x[c];
            w[c] = g->a[VX + c][i] - v[c];
            clump.kinetic += 0.5 * g->model.m * w[c] * w[c];
            clump.magnetic += 0.5 * g->model.m * g->a[BX + c][i] * g->a[BX + c][i] / g->a[RHO][i];
            d2 += d[c] * d[c];
        }
        sink_cross(d, w, turn);
        for (c = 0; c < 3; c++) {
            along += d[c] * spin[c] / axis;
            turning += turn[c] * spin[c] / axis;
        }
        if (d2 > along * along) clump.rotation += 0.5 * g->model.m * turning * turning / (d2 - along * along);
        clump.thermal += 1.5 * g->model.m * g->a[P][i] / g->a[RHO][i];
        for (l = 0; l < k; l++) {
            double r2 = 0;
            for (c = 0; c < 3; c++) r2 += pow(g->a[X + c][i] - g->a[X + c][member[l]], 2);
            clump.gravity -= 0.5 * g->model.m * g->model.m *
                             (sph_gravity_potential(COLLAPSE_KERNEL, sqrt(r2), g->a[H][i]) +
                              sph_gravity_potential(COLLAPSE_KERNEL, sqrt(r2), g->a[H][member[l]]));
        }
    }
    return clump;
}
/* Creates the sink when there is cause, and feeds it. After a step: lists and rates are those of its end. */
static inline void collapse_feed(collapse *g)
{
    sink *const core = &g->s.core;
    sph_index i;
    int c;
    g->s.objection[0] = '\0';
    if (!(core->m > 0) && g->model.rho_sink > 0 && g->s.densest > g->model.rho_sink) {
        sph_index densest = 0, members, k;
        sph_index *const member = (sph_index *)need(NULL, (size_t)g->s.n, sizeof *member);
        sink_clump clump;
        const char *objection;
        for (i = 1; i < g->s.n; i++)
            if (g->a[RHO][i] > g->a[RHO][densest]) densest = i;
        clump = collapse_clump(g, densest, member, &members);
        objection = sink_objection(&clump, g->model.radius);
        if (objection) snprintf(g->s.objection, sizeof g->s.objection, "%s", objection);
        else {
            core->radius = g->model.radius;
            core->born = g->s.t;
            core->born_step = g->s.steps;
            for (c = 0; c < 3; c++) { /* of no mass yet; where does not matter then */
                core->x[c] = g->a[X + c][densest];
                core->v[c] = g->a[VX + c][densest];
            }
            for (k = 0; k < members; k++) collapse_mark(g, member[k]);
            collapse_swallow(g);
        }
        free(member);
    }
    if (core->m > 0) {
        int some = 0;
        for (i = 0; i < g->s.n; i++) {
            double x[3], v[3];
            collapse_vector_of(g->a, X, i, x);
            collapse_vector_of(g->a, VX, i, v);
            if (sink_takes(core, 1, x, v)) {
                collapse_mark(g, i);
                some = 1;
            }
        }
        if (some) collapse_swallow(g);
    }
}

/* ---- one step ---- */

static inline void collapse_back_up(collapse *g, int restore)
{
    const size_t n = (size_t)g->room, size = n * sizeof(double);
    int k;
    for (k = 0; k < ARRAYS + EVOLVED; k++) {
        double *const now = k < ARRAYS ? g->a[k] : g->rate[k - ARRAYS], *const then =
                                                                            g->backup + (size_t)k * n;
        memcpy(restore ? now : then, restore ? then : now, size);
    }
}
/* 1: nothing has happened, and `trouble` says why. */
static inline int collapse_step(collapse *g, double dt)
{
    const collapse_state then = g->s;
    sink *const core = &g->s.core;
    sph_index i;
    int f, c;
    collapse_back_up(g, 0);
    for (i = 0; i < g->s.n; i++) {
        for (c = 0; c < 3; c++) g->a[X + c][i] += dt * (g->a[VX + c][i] + 0.5 * dt * g->rate[VX + c][i]);
        g->a[H][i] *= exp(dt * g->a[DIV_V][i] / 3); /* a good guess saves passes */
    }
    for (f = 0; f < EVOLVED; f++)
        for (i = 0; i < g->s.n; i++) {
            g->a[f][i] += dt * g->rate[f][i];
            g->before[f][i] = g->rate[f][i];
        }
    for (c = 0; c < 3; c++) {
        core->x[c] += dt * (core->v[c] + 0.5 * dt * core->a[c]);
        core->v[c] += dt * core->a[c];
        core->before[c] = core->a[c];
    }
    g->trouble[0] = '\0';
    if (!collapse_rates(g)) {
        for (f = 0; f < EVOLVED; f++)
            for (i = 0; i < g->s.n; i++) g->a[f][i] += 0.5 * dt * (g->rate[f][i] - g->before[f][i]);
        for (c = 0; c < 3; c++) {
            core->v[c] += 0.5 * dt * (core->a[c] - core->before[c]);
            g->s.impulse_gravity[c] += 0.5 * dt * (then.force_gravity[c] + g->s.force_gravity[c]);
            g->s.impulse_field[c] += 0.5 * dt * (then.force_field[c] + g->s.force_field[c]);
        }
        for (i = 0; i < g->s.n && !g->trouble[0]; i++)
            for (f = 0; f < EVOLVED; f++)
                if (!isfinite(g->a[f][i])) {
                    collapse_trouble(g, "%s of particle %ld is %g", collapse_evolved[f], (long)g->a[ID][i],
                                     g->a[f][i]);
                    break;
                }
        if (!g->trouble[0] && g->s.fastest > g->model.fastest)
            collapse_trouble(g, "the fastest signal, %.3g, exceeds %.3g", g->s.fastest, g->model.fastest);
    }
    if (g->trouble[0]) {
        g->s = then;
        collapse_back_up(g, 1);
        return 1;
    }
    g->s.t += dt;
    g->s.steps++;
    collapse_feed(g);
    return 0;
}

/* ---- what is conserved ---- */

static inline void collapse_momentum(const collapse *g, double *p)
{
    sph_index i;
    int c;
    for (c = 0; c < 3; c++) {
        p[c] = g->s.core.m * g->s.core.v[c];
        for (i = 0; i < g->s.n; i++) p[c] += g->model.m * g->a[VX + c][i];
    }
}

/* ---- restart ---- */

#define COLLAPSE_MAGIC "sph.h collapse 3"
/* Everything that the next step needs, in the order of the file. more: what the driver wants to keep; it belongs to the caller who reads. */
static inline int collapse_transfer(restart *r, collapse *g, void **more, size_t *more_size)
{
    uint64_t size = *more_size;
    int k;
    if (!restart_same(r, &g->model, sizeof g->model) || !restart_block(r, &size, sizeof size)) return 0;
    if (r->reads && size > (uint64_t)r->length) return restart_trouble(r, RESTART_DAMAGED);
    if (!restart_block(r, &g->s, sizeof g->s)) return 0;
    if (g->s.n < 1 || g->s.n > g->room) return restart_trouble(r, RESTART_DAMAGED);
    for (k = 0; k < ARRAYS; k++)
        if (!restart_block(r, g->a[k], (size_t)g->s.n * sizeof(double))) return 0;
    for (k = 0; k < EVOLVED; k++)
        if (!restart_block(r, g->rate[k], (size_t)g->s.n * sizeof(double))) return 0;
    if (r->reads) {
        *more_size = (size_t)size;
        *more = need(NULL, *more_size + 1, 1);
    }
    return restart_block(r, *more, *more_size);
}
/* dir/name.restart. 0: it could not be written, and `trouble` says why. The same program continues from it bit for bit. */
static inline int collapse_save(collapse *g, const char *dir, const char *name, void *more, size_t more_size)
{
    restart r;
    g->trouble[0] = '\0';
    if (restart_write(&r, dir, name, COLLAPSE_MAGIC) && restart_end(&r, collapse_transfer(&r, g, &more, &more_size)))
        return 1;
    return !collapse_trouble(g, "cannot write %.60s/%.60s.restart: %s", dir, name, r.trouble);
}
/* 1: g, which is new, of the same model and of no fewer particles, is what was saved; *more is the caller's to free. 0: there is no such file. -1: `trouble` says what is wrong with it. */
static inline int collapse_load(collapse *g, const char *dir, const char *name, void **more,
                                size_t *more_size)
{
    restart r;
    int found;
    *more = NULL;
    *more_size = 0;
    g->trouble[0] = '\0';
    found = restart_read(&r, dir, name, COLLAPSE_MAGIC);
    if (found > 0 && !restart_end(&r, collapse_transfer(&r, g, more, more_size))) found = -1;
    if (found < 0) collapse_trouble(g, "%s", r.trouble);
    return found;
}

#endif
