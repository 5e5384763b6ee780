/* SPDX-License-Identifier: MIT
 *
 * gas.h - an ideal gas that moves, P = (gamma - 1) rho u, in one to three dimensions; with a magnetic field (mu_0 = 1)
 * or without, under its own gravity or without. h follows the density. Its sweeps are those of sph_ops.h; this is
 * the host's side: lists, time steps, choices.
 *
 *     gas g = gas_new(dim, n, gamma);         then x, v, u, m, a guess of h, and box, free, the choices
 *     gas_magnetise(&g);                      with a field: B, too
 *     gas_start(&g);
 *     gas_run(&g, t_end, courant);            or gas_leap, or gas_step, step by step
 *     gas_close(&g);
 *
 * Two kinds of steps. gas_leap: kick, drift, kick with one evaluation of the rates, of v, u, B predicted for the
 * end of the step: v' = v + dt a, u' = u + dt du/dt. With v and u of the half step the energy would be wrong by 1e-3
 * instead of 1e-5. gas_step: the three stages of Shu & Osher 1988 (J. Comput. Phys. 77, 439), which do not amplify waves.
 *
 * Cubic spline, eta = 1.2, beta = 2, unless a driver defines GAS_KERNEL or sets eta. Gravity: G > 0, three
 * dimensions, no box, all particles free; they are then stored in the order of the tree, which changes.
 */
#ifndef GAS_H
#define GAS_H

#ifndef SPH_CHECK
#define SPH_CHECK 0 /* every step looks for what is not finite, and says where */
#endif
#include "figure.h"
#include "host.h"
#include "options.h"
#include "report.h"
#include "tree.h"

#include <math.h>
#include <string.h>

#ifndef GAS_KERNEL
#define GAS_KERNEL SPH_CUBIC_SPLINE
#endif
#ifndef GAS_DIM
#define GAS_DIM 0 /* the dimension, where a driver has but one: it compiles in a third of the time; 0: any */
#endif
#if GAS_DIM
#define GAS_SWEEP(sweep, dim, ...) sweep(GAS_KERNEL, GAS_DIM, __VA_ARGS__)
#else
#define GAS_SWEEP(sweep, dim, ...) WITH_DIM_1_2_3(sweep, GAS_KERNEL, dim, __VA_ARGS__)
#endif
#define GAS_ETA 1.2 /* h in spacings, where a driver does not set it */

/* The viscosity: alpha[1] everywhere, or a switch between alpha[0] and alpha[1]. */
typedef enum gas_switch { GAS_CONSTANT, GAS_BALSARA, GAS_MORRIS, GAS_CULLEN, GAS_PHANTOM } gas_switch;
/* what evolves, with a rate each; then what follows from it */
enum { X, Y, Z, VX, VY, VZ, BX, BY, BZ, U, PSI, ALPHA, EVOLVED };
enum { H = EVOLVED, M, KEPT };
enum {
    RHO = KEPT, OMEGA, VOLUME, P, CS, SPEED, DIV_V, DIV_B, REACH,
    DIV, DIV_BEFORE, CURL, SHEAR, RATIO, FRONT, /* for the switches */
    ZETA, GX, GY, GZ,                           /* for gravity */
    ARRAYS
};

typedef struct gas {
    int dim, parts;       /* parts: components of v and B, 3; dim is faster where that is all */
    sph_index n, free;    /* particles; the first `free` of them move, the others keep their state */
    double gamma, eta;    /* eta: h in spacings */
    double box[3];        /* periodic lengths, 0: open */
    gas_switch how;
    double alpha[2], alpha_u; /* bounds of the viscosity; the conductivity */
    int conductivity;         /* an sph_conductivity; with a field there is Price's alone */
    int magnetised;
    double alpha_B, tensile;     /* the resistivity; what is subtracted of (9) */
    double sigma, overclean, ch; /* damping; ch is `overclean` times the largest fast speed */
    int cleans;
    int still;       /* -psi div v / 2, (25), is left out */
    double left;     /* the rate of the energy that leaving it out makes */
    double G, theta; /* of gravity, and of its tree */
    tree tree;
    tree_rows rows;
    void (*forces)(struct gas *); /* in the place of the sweep that fills rate: acceleration, du/dt, SPEED; null: that */
    void *others;                 /* for it */
    search near;
    double *a[ARRAYS], *rate[EVOLVED], *before[EVOLVED], *spare, *block;
    unsigned char *status;
    double particle_steps; /* evaluations of rates times particles */
    const char *run;       /* what it is called, and its time: for messages */
    double t;
} gas;

static inline gas gas_new(int dim, sph_index n, double gamma)
{
    const size_t count = (size_t)n;
    gas g;
    int k;
    if (GAS_DIM && dim != GAS_DIM) {
        fprintf(stderr, "this program is compiled for %d dimensions, not %d\n", GAS_DIM, dim);
        exit(2);
    }
    memset(&g, 0, sizeof g);
    g.dim = dim;
    g.parts = 3;
    g.n = g.free = n;
    g.gamma = gamma;
    g.eta = GAS_ETA;
    g.alpha[1] = g.alpha_u = g.tensile = g.overclean = 1;
    g.theta = 0.5;
    g.run = "a gas";
    g.block = (double *)need_zeros((ARRAYS + 2 * EVOLVED + 1) * count, sizeof(double));
    for (k = 0; k < ARRAYS; k++) g.a[k] = g.block + (size_t)k * count;
    for (k = 0; k < EVOLVED; k++) {
        g.rate[k] = g.block + (size_t)(ARRAYS + k) * count;
        g.before[k] = g.block + (size_t)(ARRAYS + EVOLVED + k) * count;
    }
    g.spare = g.block + (size_t)(ARRAYS + 2 * EVOLVED) * count;
    g.status = (unsigned char *)need_zeros(count, 1);
    return g;
}
/* With a field; the viscosity of Morris & Monaghan, conductivity, and no cleaning unless asked for */
static inline void gas_magnetise(gas *g)
{
    g->magnetised = 1;
    g->how = GAS_MORRIS;
    g->alpha[0] = 0.1;
    g->conductivity = SPH_CONDUCTIVITY_PRICE;
    g->sigma = sph_cleaning_sigma(g->dim);
}
static inline void gas_close(gas *g)
{
    free(g->block);
    free(g->status);
    tree_free(&g->tree);
    tree_rows_free(&g->rows);
    search_close(&g->near);
}

/* ---- views ---- */

static inline sph_scalars gas_field(const gas *g, int which) { return sph_scalars_array(g->a[which]); }
static inline sph_points gas_points(const gas *g)
{
    return sph_points_periodic(sph_points_separate(g->n, g->a[X], g->a[Y], g->a[Z]), g->box[0], g->box[1], g->box[2]);
}
static inline sph_list gas_list(const gas *g)
{
    sph_list l = g->near.found.list;
    if (g->G > 0) {
        l.start = g->rows.start;
        l.index = g->rows.index;
    }
    return l;
}
/* the targets: first <= i < last */
static inline sph_cloud gas_cloud(const gas *g, long first, long last)
{
    return sph_cloud_range(sph_cloud_of(gas_points(g), gas_list(g), gas_field(g, H), gas_field(g, VOLUME)), (sph_index)first,
                           (sph_index)last);
}
static inline sph_medium gas_medium(const gas *g)
{
    const sph_medium s = {gas_field(g, M), gas_field(g, RHO), gas_field(g, OMEGA)};
    return s;
}
static inline sph_gas gas_state(const gas *g)
{
    const sph_gas s = {.medium = gas_medium(g),
                       .p = gas_field(g, P),
                       .u = gas_field(g, U),
                       .cs = gas_field(g, CS),
                       .alpha = gas_field(g, ALPHA),
                       .v = vectors_of(g->a + VX, g->parts),
                       .beta = 2,
                       .alpha_u = g->alpha_u,
                       .conductivity = g->conductivity};
    return s;
}
/* of the vector whose first component is array number `first` */
static inline double gas_square(const gas *g, int first, sph_index i)
{
    return g->a[first][i] * g->a[first][i] + g->a[first + 1][i] * g->a[first + 1][i] + g->a[first + 2][i] * g->a[first + 2][i];
}
/* The first particle whose state is no number is named. */
static inline void gas_well(const gas *g, sph_index answer)
{
    static const char *const name[EVOLVED] = {"x", "y", "z", "vx", "vy", "vz", "Bx", "By", "Bz", "u", "psi", "alpha"};
    expect_finite(answer, g->run, g->t, g->a, name, EVOLVED, gas_points(g));
}

/* ---- density ---- */

static inline long gas_density_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_density_options options = {gas_field(g, REACH), g->eta, 1e-4};
    const sph_density_out out = {.h = g->a[H], .rho = g->a[RHO], .omega = g->a[OMEGA], .status = g->status};
    return GAS_SWEEP(sph_density_adaptive, g->dim, gas_cloud(g, first, last), gas_field(g, M), options, out);
}
/* (4), (5) for the particles before `last`; lists for an h that grows by 4 % */
static inline void gas_density(gas *g, sph_index last)
{
    sph_index i, failed = 1;
    while (failed > 0) { /* an h outgrew its list */
        for (i = 0; i < g->n; i++) g->a[REACH][i] = 1.04 * sph_kernel_support_ratio(GAS_KERNEL) * g->a[H][i];
        if (g->G > 0) {
            tree_reach(&g->tree, g->a[REACH]);
            tree_neighbours(&g->tree, g->a[X], g->a[Y], g->a[Z], g->a[REACH], 0, &g->rows);
        } else search_all(&g->near, g->dim, gas_points(g), gas_field(g, REACH), SPH_LARGER);
        failed = (sph_index)threads_each(last, gas_density_part, g);
        expect(failed);
        for (i = 0; i < last && failed > 0; i++)
            if (g->status[i] != SPH_OK && g->status[i] != SPH_LIST_TOO_SHORT) {
                fprintf(stderr, "\n%s, t = %g: density of particle %ld at (%g, %g, %g): %s; the run stops\n", g->run, g->t, (long)i,
                        g->a[X][i], g->a[Y][i], g->a[Z][i], sph_status_text(g->status[i]));
                exit(1);
            }
    }
    for (i = 0; i < last; i++) g->a[VOLUME][i] = g->a[M][i] / g->a[RHO][i];
}

/* ---- gravity ---- */

static inline void gas_permute(gas *g, double **p)
{
    double *const old = *p;
    expect_all(sph_permute(g->n, g->tree.order, old, 1, g->spare));
    *p = g->spare;
    g->spare = old;
}
/* into the order of a new tree */
static inline void gas_sort(gas *g)
{
    int k;
    tree_order(&g->tree, g->n, g->a[X], g->a[Y], g->a[Z]);
    for (k = 0; k < KEPT; k++) gas_permute(g, &g->a[k]);
    for (k = 0; k < EVOLVED; k++) gas_permute(g, &g->before[k]);
    gas_permute(g, &g->a[DIV_BEFORE]);
}
static inline long gas_tree_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    tree_gravity(GAS_KERNEL, &g->tree, (int)first, (int)last, g->theta, g->a[X], g->a[Y], g->a[Z], g->a[M], g->a[H], g->G, gas_list(g),
                 g->a[GX], g->a[GY], g->a[GZ]);
    return 0;
}
static inline long gas_zeta_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    return sph_gravity_zeta(GAS_KERNEL, gas_cloud(g, first, last), gas_field(g, M), gas_field(g, RHO), sph_scalar_out_array(g->a[ZETA], NULL));
}
static inline long gas_correction_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    return sph_gravity_correction(GAS_KERNEL, gas_cloud(g, first, last), gas_medium(g), gas_field(g, ZETA), g->G,
                                  vectors_into(g->a + GX, 3));
}
static inline void gas_add_pull(gas *g)
{
    sph_index i;
    int k;
    for (k = 0; k < 3; k++)
        for (i = 0; i < g->n; i++) g->rate[VX + k][i] += g->a[GX + k][i];
}
/* Adds to the acceleration: softened by the kernel, with the term of an h that follows the density */
static inline void gas_gravity(gas *g)
{
    sph_index i;
    for (i = 0; i < g->n; i++) g->a[REACH][i] = sph_kernel_support_ratio(GAS_KERNEL) * g->a[H][i];
    tree_reach(&g->tree, g->a[REACH]);
    tree_moments(&g->tree, g->a[X], g->a[Y], g->a[Z], g->a[M]);
    expect_all((sph_index)threads_each(g->tree.leaves, gas_tree_part, g));
    gas_add_pull(g);
    expect_all((sph_index)threads_each(g->n, gas_zeta_part, g));
    expect_all((sph_index)threads_each(g->n, gas_correction_part, g));
    gas_add_pull(g);
}
typedef struct gas_potential_job {
    const gas *g;
    double *phi;
} gas_potential_job;
static inline long gas_potential_part(void *data, long first, long last)
{
    const gas_potential_job *const job = (const gas_potential_job *)data;
    const gas *const g = job->g;
    return sph_gravity_direct(GAS_KERNEL, gas_cloud(g, first, last), gas_field(g, M), g->G, vectors_into(g->a + GX, 3),
                              sph_scalar_out_array(job->phi, NULL));
}
/* The energy of gravity, by all pairs: n^2 steps */
static inline double gas_potential(const gas *g)
{
    gas_potential_job job;
    double sum = 0;
    sph_index i;
    job.g = g;
    job.phi = (double *)need(NULL, (size_t)g->n, sizeof(double));
    expect_all((sph_index)threads_each(g->n, gas_potential_part, &job));
    for (i = 0; i < g->n; i++) sum += 0.5 * g->a[M][i] * job.phi[i];
    free(job.phi);
    return sum;
}

/* ---- the switches of the viscosity that look at the flow ---- */

static inline long gas_gradient_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_velocity_gradient_out out = {.div = g->a[DIV], .curl = g->a[CURL], .shear = g->a[SHEAR]};
    return GAS_SWEEP(sph_velocity_gradient_cspm, g->dim, gas_cloud(g, first, last), vectors_of(g->a + VX, 3), out);
}
static inline long gas_shock_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_shock_out out = {.ratio = g->a[RATIO], .v_sig = g->a[FRONT]};
    return GAS_SWEEP(sph_shock_indicator, g->dim, gas_cloud(g, first, last), gas_state(g), gas_field(g, DIV), out);
}
/* alpha of each particle after a step dt; d(div v)/dt is a difference in time */
static inline void gas_switches(gas *g, double dt)
{
    sph_index i;
    expect_all((sph_index)threads_each(g->free, gas_gradient_part, g));
    if (g->how == GAS_BALSARA) { /* a function of the flow: it needs no time */
        for (i = 0; i < g->free; i++) {
            const sph_flow f = {g->a[DIV][i], g->a[CURL][i], g->a[SHEAR][i], 0};
            g->a[ALPHA][i] = g->alpha[1] * sph_viscosity_factor_balsara(f, g->a[CS][i], g->a[H][i]);
        }
        return;
    }
    expect_all((sph_index)threads_each(g->free, gas_shock_part, g));
    for (i = 0; i < g->free && dt > 0; i++) {
        const sph_switch s = {g->a[ALPHA][i], g->alpha[0], g->alpha[1]};
        const sph_flow f = {g->a[DIV][i], g->a[CURL][i], g->a[SHEAR][i], 0};
        sph_shock shock = {(g->a[DIV][i] - g->a[DIV_BEFORE][i]) / dt, 0, g->a[H][i], g->a[CS][i], g->a[FRONT][i]};
        if (g->how == GAS_CULLEN) {
            shock.factor = sph_shock_factor_cullen_dehnen(f, g->a[RATIO][i]);
            g->a[ALPHA][i] = sph_viscosity_switch_after(s, shock, sph_viscosity_target_cullen_dehnen(s, shock), dt);
        } else {
            shock.factor = sph_shock_factor_phantom(f);
            g->a[ALPHA][i] = sph_viscosity_switch_after(s, shock, sph_viscosity_target_phantom(s, shock), dt);
        }
    }
    memcpy(g->a[DIV_BEFORE], g->a[DIV], (size_t)g->n * sizeof(double));
}

/* ---- rates ---- */

static inline long gas_rates_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_gas_out out = {
        .acceleration = vectors_into(g->rate + VX, 3), .rate_u = g->rate[U], .div_v = g->a[DIV_V], .v_sig = g->a[SPEED]};
    return GAS_SWEEP(sph_gas_rates, g->dim, gas_cloud(g, first, last), gas_state(g), out);
}
static inline long gas_mhd_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_mhd s = {.medium = gas_medium(g),
                       .p = gas_field(g, P),
                       .u = gas_field(g, U),
                       .cs = gas_field(g, CS),
                       .alpha = gas_field(g, ALPHA),
                       .alpha_B = sph_scalars_same(&g->alpha_B),
                       .v = vectors_of(g->a + VX, g->parts),
                       .field = vectors_of(g->a + BX, g->parts),
                       .psi = sph_scalars_array(g->cleans ? g->a[PSI] : NULL),
                       .ch = g->ch,
                       .sigma = g->sigma,
                       .beta = 2,
                       .alpha_u = g->conductivity == SPH_CONDUCTIVITY_NONE ? 0 : g->alpha_u,
                       .tensile = g->tensile};
    const sph_mhd_out out = {.acceleration = vectors_into(g->rate + VX, 3),
                             .rate_B = vectors_into(g->rate + BX, 3),
                             .rate_u = g->rate[U],
                             .rate_psi = g->rate[PSI],
                             .div_B = g->a[DIV_B],
                             .div_v = g->a[DIV_V],
                             .v_sig = g->a[SPEED]};
    return GAS_SWEEP(sph_mhd_rates, g->dim, gas_cloud(g, first, last), s, out);
}
/* pressure and sound speed; the largest fast speed */
static inline double gas_pressure(gas *g)
{
    double fastest = 0;
    sph_index i;
    for (i = 0; i < g->n; i++) {
        g->a[P][i] = (g->gamma - 1) * g->a[RHO][i] * g->a[U][i];
        g->a[CS][i] = sqrt(g->gamma * (g->gamma - 1) * fmax(g->a[U][i], 0));
        fastest = fmax(fastest, g->a[CS][i] * g->a[CS][i] + gas_square(g, BX, i) / g->a[RHO][i]);
    }
    return sqrt(fastest);
}
/* dt: of the step that ends with this state; below 0: a stage within a step, which keeps its ch */
static inline void gas_rates(gas *g, double dt)
{
    double fastest;
    sph_index i;
    int k;
    for (k = 0; k < EVOLVED; k++)
        for (i = 0; i < g->free; i++)
            if (!isfinite(g->a[k][i])) gas_well(g, 1);
    if (g->G > 0) gas_sort(g);
    gas_density(g, g->free);
    fastest = gas_pressure(g);
    if (dt >= 0) g->ch = g->overclean * fastest;
    if (g->how != GAS_CONSTANT && g->how != GAS_MORRIS) gas_switches(g, dt);
    if (g->forces) g->forces(g);
    else gas_well(g, (sph_index)threads_each(g->free, g->magnetised ? gas_mhd_part : gas_rates_part, g));
    if (g->G > 0) gas_gravity(g);
    g->left = 0;
    for (i = 0; i < g->free; i++) {
        const sph_switch alpha = {g->a[ALPHA][i], g->alpha[0], g->alpha[1]};
        for (k = 0; k < g->dim; k++) g->rate[X + k][i] = g->a[VX + k][i];
        if (g->how == GAS_MORRIS) g->rate[ALPHA][i] = sph_viscosity_switch_rate(alpha, g->a[SPEED][i], g->a[H][i], g->a[DIV_V][i]);
        if (g->cleans && g->still) {
            const double term = 0.5 * g->a[PSI][i] * g->a[DIV_V][i];
            g->rate[PSI][i] += term;
            g->left += g->a[M][i] / g->a[RHO][i] * g->a[PSI][i] * term / (g->ch * g->ch);
        }
    }
    g->particle_steps += (double)g->free;
}
/* Density of all particles, and the first rates: after x, m, v, u, a guess of h, and B are set; and alpha, where it
   is to be more than the least */
static inline void gas_start(gas *g)
{
    sph_index i;
    for (i = 0; i < g->n; i++) g->a[ALPHA][i] = g->how == GAS_CONSTANT ? g->alpha[1] : fmax(g->a[ALPHA][i], g->alpha[0]);
    if (g->G > 0) gas_sort(g);
    gas_density(g, g->n);
    gas_rates(g, 0);
}

/* ---- steps ---- */

/* courant times the least of h / v_sig, h / ch, 0.8 sqrt(h / |a|) */
static inline double gas_longest_step(const gas *g, double courant)
{
    double dt = HUGE_VAL;
    sph_index i;
    for (i = 0; i < g->free; i++) {
        const double speed = g->cleans ? fmax(g->a[SPEED][i], g->ch) : g->a[SPEED][i];
        const double a = sqrt(g->rate[VX][i] * g->rate[VX][i] + g->rate[VY][i] * g->rate[VY][i] + g->rate[VZ][i] * g->rate[VZ][i]);
        dt = fmin(dt, fmin(g->a[H][i] / speed, 0.8 * sqrt(g->a[H][i] / a)));
    }
    return courant * dt;
}
/* From t to t + dt in three stages. The rates at hand are those of t, and then those of t + dt. */
static inline void gas_step(gas *g, double dt)
{
    static const double kept[3] = {0, 3.0 / 4, 1.0 / 3};
    int stage, k;
    sph_index i;
    for (k = 0; k < EVOLVED; k++) memcpy(g->before[k], g->a[k], (size_t)g->n * sizeof(double));
    for (stage = 0; stage < 3; stage++) {
        for (k = 0; k < EVOLVED; k++)
            for (i = 0; i < g->free; i++)
                g->a[k][i] = kept[stage] * g->before[k][i] + (1 - kept[stage]) * (g->a[k][i] + dt * g->rate[k][i]);
        if (stage == 2) g->t += dt;
        gas_rates(g, stage == 2 ? dt : -1);
    }
}
/* From t to t + dt with one evaluation. The rates at hand are those of the state predicted for t, then for t + dt. */
static inline void gas_leap(gas *g, double dt)
{
    const int last = g->how == GAS_MORRIS ? EVOLVED : ALPHA; /* alpha of the others is not integrated */
    int k;
    sph_index i;
    for (k = VX; k < last; k++)
        for (i = 0; i < g->free; i++) {
            g->before[k][i] = g->a[k][i] + 0.5 * dt * g->rate[k][i];
            g->a[k][i] += dt * g->rate[k][i];
        }
    for (k = 0; k < g->dim; k++)
        for (i = 0; i < g->free; i++) g->a[X + k][i] += dt * g->before[VX + k][i];
    g->t += dt;
    gas_rates(g, dt);
    for (k = VX; k < last; k++)
        for (i = 0; i < g->free; i++) g->a[k][i] = g->before[k][i] + 0.5 * dt * g->rate[k][i];
}
/* As many of them as it takes */
static inline void gas_run(gas *g, double end, double courant)
{
    while (g->t < end) {
        const double dt = gas_longest_step(g, courant);
        if (dt < end - g->t) gas_leap(g, dt);
        else {
            gas_leap(g, end - g->t);
            g->t = end;
        }
    }
}

/* ---- what is measured ---- */

typedef struct gas_sums {
    double kinetic, thermal, magnetic, psi, total; /* energies; psi: sum m psi^2 / (2 rho ch^2) */
    double momentum;                               /* its length */
    double error, largest, robust; /* h |div B| / |B|: mean, largest; and the ratio of means */
    double div_B;                  /* largest |div B| */
} gas_sums;

/* Of the particles that move; div B in difference form as of the last rates. Without gravity: see gas_potential */
static inline gas_sums gas_measure(const gas *g)
{
    gas_sums s;
    double divergence = 0, field = 0, push[3] = {0, 0, 0};
    sph_index i;
    int k;
    memset(&s, 0, sizeof s);
    for (i = 0; i < g->free; i++) {
        const double m = g->a[M][i], V = m / g->a[RHO][i], h_div = g->a[H][i] * fabs(g->a[DIV_B][i]);
        const double B2 = gas_square(g, BX, i);
        s.kinetic += 0.5 * m * gas_square(g, VX, i);
        s.thermal += m * g->a[U][i];
        for (k = 0; k < 3; k++) push[k] += m * g->a[VX + k][i];
        if (!g->magnetised) continue;
        s.magnetic += 0.5 * V * B2;
        if (g->cleans) s.psi += 0.5 * V * g->a[PSI][i] * g->a[PSI][i] / (g->ch * g->ch);
        s.error += h_div / sqrt(B2) / g->free;
        s.largest = fmax(s.largest, h_div / sqrt(B2));
        s.div_B = fmax(s.div_B, fabs(g->a[DIV_B][i]));
        divergence += h_div;
        field += sqrt(B2);
    }
    s.total = s.kinetic + s.thermal + s.magnetic + s.psi;
    s.momentum = sqrt(push[0] * push[0] + push[1] * push[1] + push[2] * push[2]);
    s.robust = divergence / field;
    return s;
}

#endif
