/* SPDX-License-Identifier: MIT
 *
 * cleaning_gas.h - a magnetised gas that moves, in two and three dimensions: all of SPMHD as sph_ops.h has it, h of each particle's own, in steps of Runge-Kutta's kind. For the drivers of the
 * divergence-cleaning paper that go beyond it. Ideal gas, P = (gamma - 1) rho u; mu_0 = 1.
 */
#ifndef CLEANING_GAS_H
#define CLEANING_GAS_H

#ifndef SPH_CHECK
#define SPH_CHECK 0 /* every step looks for what is not finite, and says where */
#endif
#include "cleaning.h"
#include "cleaning_forms.h"

#include <string.h>

/* what evolves, with a rate each; then what follows from it */
enum {
    X,
    Y,
    Z,
    VX,
    VY,
    VZ,
    BX,
    BY,
    BZ,
    U,
    PSI,
    ALPHA,
    EVOLVED,
    H = EVOLVED,
    RHO,
    OMEGA,
    M,
    P,
    CS,
    SPEED,
    DIV_V,
    DIV_B,
    REACH,
    ARRAYS
};

typedef struct gas {
    int dim, parts;       /* components of v and B: dim, or 3 */
    sph_index n, free;    /* particles; the first `free` of them move, the others keep their state */
    double gamma, box[3]; /* periodic lengths, 0: open */
    double alpha[2], alpha_u, alpha_B,
        tensile; /* range of the viscosity; the conductivity; the resistivity; what is subtracted of (9) */
    double sigma, overclean, ch; /* damping; ch is `overclean` times the largest fast speed */
    int cleans, form;            /* form: CONJUGATE or DIFFERENCES */
    int still;                   /* -psi div v / 2, (25), is left out */
    double left;                 /* the rate of the energy that leaving it out makes */
    search near;
    double *a[ARRAYS], *rate[EVOLVED], *before[EVOLVED];
    unsigned char *status;
    double particle_steps; /* evaluations of rates times particles */
    const char *run;       /* what it is called, and its time: for messages */
    double t;
} gas;

enum { CONJUGATE, DIFFERENCES };

static inline gas gas_new(int dim, int parts, sph_index n, double gamma)
{
    const size_t count = (size_t)n;
    gas g;
    int k;
    memset(&g, 0, sizeof g);
    g.dim = dim;
    g.parts = parts;
    g.n = g.free = n;
    g.gamma = gamma;
    g.alpha[0] = 0.1;
    g.alpha[1] = 1;
    g.alpha_u = g.tensile = g.overclean = 1;
    g.sigma = sph_cleaning_sigma(dim);
    g.run = "a gas";
    g.a[0] = (double *)need_zeros((ARRAYS + 2 * EVOLVED) * count, sizeof(double));
    for (k = 1; k < ARRAYS; k++) g.a[k] = g.a[0] + (size_t)k * count;
    for (k = 0; k < EVOLVED; k++) {
        g.rate[k] = g.a[0] + (size_t)(ARRAYS + k) * count;
        g.before[k] = g.a[0] + (size_t)(ARRAYS + EVOLVED + k) * count;
    }
    g.status = (unsigned char *)need_zeros(count, 1);
    return g;
}
static inline void gas_close(gas *g)
{
    free(g->a[0]);
    free(g->status);
    search_close(&g->near);
}
static inline sph_points gas_points(const gas *g)
{
    return sph_points_periodic(sph_points_separate(g->n, g->a[X], g->a[Y], g->a[Z]), g->box[0], g->box[1],
                               g->box[2]);
}
/* the targets: first <= i < last */
static inline sph_cloud gas_cloud(const gas *g, long first, long last)
{
    return sph_cloud_range(
        sph_cloud_of(gas_points(g), g->near.found.list, sph_scalars_array(g->a[H]), sph_scalars_none()),
        (sph_index)first, (sph_index)last);
}
/* of the vector whose first component is array number `first` */
static inline double gas_square(const gas *g, int first, sph_index i)
{
    return g->a[first][i] * g->a[first][i] + g->a[first + 1][i] * g->a[first + 1][i] +
           g->a[first + 2][i] * g->a[first + 2][i];
}
/* The first particle whose state is no number is named. */
static inline void gas_well(const gas *g, sph_index answer)
{
    static const char *const name[EVOLVED] = {"x",  "y",  "z",  "vx", "vy",  "vz",
                                              "Bx", "By", "Bz", "u",  "psi", "alpha"};
    cleaning_well(answer, g->run, g->t, g->a, name, EVOLVED, gas_points(g));
}

/* ---- density, rates ---- */

/* Lists for an h that grows by 4 % */
static inline void gas_lists(gas *g)
{
    sph_index i;
    for (i = 0; i < g->n; i++)
        g->a[REACH][i] = 1.04 * sph_kernel_support_ratio(SPH_CUBIC_SPLINE) * g->a[H][i];
    search_all(&g->near, g->dim, gas_points(g), sph_scalars_array(g->a[REACH]), SPH_LARGER);
}
static inline long gas_density_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_kernel k = SPH_CUBIC_SPLINE;
    const sph_cloud cloud = gas_cloud(g, first, last);
    const sph_scalars m = sph_scalars_array(g->a[M]);
    const sph_density_options options = {sph_scalars_array(g->a[REACH]), CLEANING_ETA, 1e-4};
    const sph_density_out out = {.h = g->a[H], .rho = g->a[RHO], .omega = g->a[OMEGA], .status = g->status};
    return WITH_DIM_2_3(sph_density_adaptive, k, g->dim, cloud, m, options, out);
}
/* (4), (5) for the particles before `last` */
static inline void gas_density(gas *g, sph_index last)
{
    sph_index i, failed = 1;
    while (failed > 0) { /* an h outgrew its list */
        gas_lists(g);
        failed = (sph_index)threads_each(last, gas_density_part, g);
        expect(failed);
        for (i = 0; i < last && failed > 0; i++)
            if (g->status[i] != SPH_OK && g->status[i] != SPH_LIST_TOO_SHORT) {
                fprintf(stderr, "\n%s, t = %g: density of particle %ld at (%g, %g, %g): %s; the run stops\n",
                        g->run, g->t, (long)i, g->a[X][i], g->a[Y][i], g->a[Z][i],
                        sph_status_text(g->status[i]));
                exit(1);
            }
    }
}
static inline long gas_rates_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_kernel k = SPH_CUBIC_SPLINE;
    const int dim = g->dim;
    const sph_cloud cloud = gas_cloud(g, first, last);
    const int other = g->cleans && g->form == DIFFERENCES;
    sph_mhd s;
    sph_mhd_out out = {0};
    sph_index failed;
    s.medium.m = sph_scalars_array(g->a[M]);
    s.medium.rho = sph_scalars_array(g->a[RHO]);
    s.medium.omega = sph_scalars_array(g->a[OMEGA]);
    s.p = sph_scalars_array(g->a[P]);
    s.u = sph_scalars_array(g->a[U]);
    s.cs = sph_scalars_array(g->a[CS]);
    s.alpha = sph_scalars_array(g->a[ALPHA]);
    s.v = vectors_of(g->a + VX, g->parts);
    s.field = vectors_of(g->a + BX, g->parts);
    s.psi = sph_scalars_array(g->cleans && !other ? g->a[PSI] : NULL);
    s.ch = g->ch;
    s.sigma = g->sigma;
    s.beta = 2;
    s.alpha_u = g->alpha_u;
    s.alpha_B = sph_scalars_same(&g->alpha_B);
    s.tensile = g->tensile;
    out.acceleration = vectors_into(g->rate + VX, 3);
    out.rate_B = vectors_into(g->rate + BX, 3);
    out.rate_u = g->rate[U];
    out.rate_psi = g->rate[PSI];
    out.div_B = g->a[DIV_B];
    out.div_v = g->a[DIV_V];
    out.v_sig = g->a[SPEED];
    failed = WITH_DIM_2_3(sph_mhd_rates, k, dim, cloud, s, out);
    if (failed == 0 && other) { /* its rates of B in the place of those of x, which come last */
        const sph_cleaning of = {.medium = s.medium,
                                 .field = vectors_of(g->a + BX, dim),
                                 .psi = sph_scalars_array(g->a[PSI]),
                                 .div_v = sph_scalars_array(g->a[DIV_V]),
                                 .ch = g->ch,
                                 .sigma = g->sigma};
        const sph_cleaning_out to = {
            .rate_B = vectors_into(g->rate + X, 3), .rate_psi = g->rate[PSI], .div_B = NULL};
        sph_index i;
        int c;
        failed = WITH_DIM_2_3(cleaning_rates_nonconservative, k, dim, cloud, of, to);
        for (c = 0; c < dim; c++)
            for (i = (sph_index)first; i < last; i++) g->rate[BX + c][i] += g->rate[X + c][i];
    }
    return failed;
}
/* renew: with the ch of this state */
static inline void gas_rates(gas *g, int renew)
{
    double fastest = 0;
    sph_index i;
    int k;
    for (k = 0; k < EVOLVED; k++)
        for (i = 0; i < g->free; i++)
            if (!isfinite(g->a[k][i])) gas_well(g, 1);
    gas_density(g, g->free);
    for (i = 0; i < g->n; i++) {
        g->a[P][i] = (g->gamma - 1) * g->a[RHO][i] * g->a[U][i];
        g->a[CS][i] = sqrt(g->gamma * (g->gamma - 1) * fmax(g->a[U][i], 0));
        fastest = fmax(fastest, g->a[CS][i] * g->a[CS][i] + gas_square(g, BX, i) / g->a[RHO][i]);
    }
    if (renew) g->ch = g->overclean * sqrt(fastest);
    gas_well(g, (sph_index)threads_each(g->free, gas_rates_part, g));
    g->left = 0;
    for (i = 0; i < g->free; i++) {
        const sph_switch alpha = {g->a[ALPHA][i], g->alpha[0], g->alpha[1]};
        for (k = 0; k < g->dim; k++) g->rate[X + k][i] = g->a[VX + k][i];
        g->rate[ALPHA][i] = sph_viscosity_switch_rate(alpha, g->a[SPEED][i], g->a[H][i], g->a[DIV_V][i]);
        if (g->cleans && g->still) {
            const double term = 0.5 * g->a[PSI][i] * g->a[DIV_V][i];
            g->rate[PSI][i] += term;
            g->left += g->a[M][i] / g->a[RHO][i] * g->a[PSI][i] * term / (g->ch * g->ch);
        }
    }
    g->particle_steps += (double)g->free;
}

/* Density of all particles, and the first rates: after x, m, v, B, u and a guess of h are set */
static inline void gas_start(gas *g)
{
    sph_index i;
    for (i = 0; i < g->n; i++) g->a[ALPHA][i] = g->alpha[1];
    gas_density(g, g->n);
    gas_rates(g, 1);
}

/* ---- steps: the three stages of Shu & Osher 1988 (J. Comput. Phys. 77, 439), which do not amplify waves ---- */

/* courant times the least of h / v_sig, h / ch, 0.8 sqrt(h / |a|) */
static inline double gas_longest_step(const gas *g, double courant)
{
    double dt = HUGE_VAL;
    sph_index i;
    for (i = 0; i < g->free; i++) {
        const double speed = g->cleans ? fmax(g->a[SPEED][i], g->ch) : g->a[SPEED][i];
        const double a = sqrt(g->rate[VX][i] * g->rate[VX][i] + g->rate[VY][i] * g->rate[VY][i] +
                              g->rate[VZ][i] * g->rate[VZ][i]);
        dt = fmin(dt, fmin(g->a[H][i] / speed, 0.8 * sqrt(g->a[H][i] / a)));
    }
    return courant * dt;
}
/* From t to t + dt. The rates at hand are those of t, and then those of t + dt. */
static inline void gas_step(gas *g, double dt)
{
    static const double kept[3] = {0, 3.0 / 4, 1.0 / 3};
    int stage, k;
    sph_index i;
    memcpy(g->before[0], g->a[0], (size_t)EVOLVED * (size_t)g->n * sizeof(double));
    for (stage = 0; stage < 3; stage++) {
        for (k = 0; k < EVOLVED; k++)
            for (i = 0; i < g->free; i++)
                g->a[k][i] =
                    kept[stage] * g->before[k][i] + (1 - kept[stage]) * (g->a[k][i] + dt * g->rate[k][i]);
        if (stage == 2) g->t += dt;
        gas_rates(g, stage == 2);
    }
}

/* ---- what is measured ---- */

typedef struct gas_sums {
    double kinetic, thermal, magnetic, psi, total; /* energies; psi: sum m psi^2 / (2 rho ch^2) */
    double error, largest, robust; /* h |div B| / |B|: mean, largest; and the ratio of means */
    double div_B;                  /* largest |div B| */
} gas_sums;

/* Of the particles that move; div B in difference form as of the last rates */
static inline gas_sums gas_measure(const gas *g)
{
    gas_sums s;
    double divergence = 0, field = 0;
    sph_index i;
    memset(&s, 0, sizeof s);
    for (i = 0; i < g->free; i++) {
        const double m = g->a[M][i], V = m / g->a[RHO][i], h_div = g->a[H][i] * fabs(g->a[DIV_B][i]);
        const double B2 = gas_square(g, BX, i);
        s.kinetic += 0.5 * m * gas_square(g, VX, i);
        s.thermal += m * g->a[U][i];
        s.magnetic += 0.5 * V * B2;
        if (g->cleans) s.psi += 0.5 * V * g->a[PSI][i] * g->a[PSI][i] / (g->ch * g->ch);
        s.error += h_div / sqrt(B2) / g->free;
        s.largest = fmax(s.largest, h_div / sqrt(B2));
        s.div_B = fmax(s.div_B, fabs(g->a[DIV_B][i]));
        divergence += h_div;
        field += sqrt(B2);
    }
    s.total = s.kinetic + s.thermal + s.magnetic + s.psi;
    s.robust = divergence / field;
    return s;
}

#endif
