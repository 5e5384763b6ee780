/* SPDX-License-Identifier: MIT
 *
 * vortex.c - the Orszag-Tang vortex twice, side by side: on the left nobody cares for div B, on the right it
 * is cleaned. The equations are those of ../papers/cleaning_orszag_tang.c: periodic unit square, gamma = 5/3,
 * rho = 25 / (36 pi), P = 5 / (12 pi), v = (-sin 2 pi y, sin 2 pi x), B = (-sin 2 pi y, sin 4 pi x) /
 * sqrt(4 pi).
 */
#include "lab.h"

enum { DIM = 2, MOST = 64 * 72, BOTH = 2 * MOST };
enum { KERNEL, COLUMNS, SIGMA, OVERCLEAN, ALPHA_B, CONTROLS };
enum { DIV_B, DENSITY, FIELD, PRESSURE, FIELDS };
enum { LEFT, RIGHT, ERROR_RATIO, ENERGY_LEFT, ENERGY_RIGHT, DT, MEASURES };
static const double pi = 3.14159265358979324, gamma53 = 5.0 / 3, apart = 1.06;

static lab_control controls[CONTROLS] = {
    {"kernel", "Kernel", "cubic-spline|quintic-spline", 0, 1, 1, 0, 0},
    {"columns", "Columns of particles", NULL, 16, 64, 4, 36, 0},
    {"sigma", "Damping sigma of the cleaning", NULL, 0, 2, 0.05, 0.3, 0},
    {"overclean", "Speed of the cleaning / fast speed", NULL, 0.25, 4, 0.25, 1, 0},
    {"alpha_B", "Resistivity alpha_B of both", NULL, 0, 1, 0.05, 0, 0}};

/* what evolves; each has a rate, and the rate of the step before */
enum { VX, VY, BX, BY, U, PSI, ALPHA, EVOLVED };
typedef struct gas {
    int cleans;
    double ch, a[EVOLVED][MOST], rate[EVOLVED][MOST], before[EVOLVED][MOST];
    double x[MOST], y[MOST], h[MOST], rho[MOST], omega[MOST], p[MOST], cs[MOST], speed[MOST], div_v[MOST],
        div_B[MOST];
} gas;
static gas both[2];
static int n; /* of each */
static double m, dt;

static sph_points points(const gas *g)
{
    return sph_points_periodic(sph_points_separate(n, g->x, g->y, NULL), 1, 1, 0);
}
static int outgrown(const unsigned char *status) /* 1: the list of a particle is too short; or an error */
{
    int i, found = 0;
    for (i = 0; i < n; i++) {
        if (status[i] == SPH_LIST_TOO_SHORT) found = 1;
        else if (status[i] != SPH_OK) return SPH_ERROR_VALUE;
    }
    return found;
}
#define SWEEPS(K) answer = sweeps(K, g)
static inline __attribute__((always_inline)) int sweeps(sph_kernel k, gas *g)
{
    static double reach[MOST];
    static unsigned char status[MOST];
    const double alpha_B = controls[ALPHA_B].value, eta = k == SPH_CUBIC_SPLINE ? 1.2 : 1.0;
    sph_density_options options;
    sph_density_out density;
    sph_list list = {NULL, NULL};
    sph_cloud cloud;
    sph_mhd state;
    sph_mhd_out out = {0};
    double fastest = 0;
    int i, short_list;
    do { /* h and density, with lists for an h that grows by 4 % */
        for (i = 0; i < n; i++) reach[i] = 1.04 * sph_kernel_support(k, g->h[i]);
        LAB_TRY(lab_neighbours(DIM, points(g), sph_scalars_array(reach), SPH_LARGER, &list));
        cloud = sph_cloud_of(points(g), list, sph_scalars_array(g->h), sph_scalars_none());
        options.list_radius = sph_scalars_array(reach);
        options.eta = eta;
        options.tolerance = 1e-6;
        density.h = g->h;
        density.rho = g->rho;
        density.omega = g->omega;
        density.stride = 1;
        density.status = status;
        LAB_TRY(sph_density_adaptive(k, DIM, cloud, sph_scalars_same(&m), options, density));
        LAB_TRY(short_list = outgrown(status));
    } while (short_list);
    for (i = 0; i < n; i++) { /* what follows from u, rho and B */
        const double B2 = g->a[BX][i] * g->a[BX][i] + g->a[BY][i] * g->a[BY][i];
        const double u = fmax(g->a[U][i], 0), cs2 = gamma53 * (gamma53 - 1) * u;
        g->p[i] = (gamma53 - 1) * g->rho[i] * u;
        g->cs[i] = sqrt(cs2);
        fastest = fmax(fastest, cs2 + B2 / g->rho[i]);
    }
    g->ch = controls[OVERCLEAN].value * sqrt(fastest);
    state.medium.m = sph_scalars_same(&m);
    state.medium.rho = sph_scalars_array(g->rho);
    state.medium.omega = sph_scalars_array(g->omega);
    state.p = sph_scalars_array(g->p);
    state.u = sph_scalars_array(g->a[U]);
    state.cs = sph_scalars_array(g->cs);
    state.alpha = sph_scalars_array(g->a[ALPHA]);
    state.alpha_B = sph_scalars_same(&alpha_B);
    state.v = sph_vectors_separate(g->a[VX], g->a[VY], NULL);
    state.field = sph_vectors_separate(g->a[BX], g->a[BY], NULL);
    state.psi = g->cleans ? sph_scalars_array(g->a[PSI]) : sph_scalars_none();
    state.ch = g->ch;
    state.sigma = controls[SIGMA].value;
    state.beta = 2;
    state.alpha_u = 1;
    state.tensile = 1;
    out.acceleration = sph_vector_out_separate(g->rate[VX], g->rate[VY], NULL);
    out.rate_B = sph_vector_out_separate(g->rate[BX], g->rate[BY], NULL);
    out.rate_u = g->rate[U];
    out.rate_psi = g->cleans ? g->rate[PSI] : NULL;
    out.div_B = g->div_B;
    out.div_v = g->div_v;
    out.v_sig = g->speed;
    LAB_TRY(sph_mhd_rates(k, DIM, cloud, state, out));
    for (i = 0; i < n; i++) {
        const sph_switch alpha = {g->a[ALPHA][i], 0.1, 2};
        g->rate[ALPHA][i] = sph_viscosity_switch_rate(alpha, g->speed[i], g->h[i], g->div_v[i]);
    }
    return 0;
}
static int rates(gas *g)
{
    int answer;
    if (controls[KERNEL].value > 0) SWEEPS(SPH_QUINTIC_SPLINE);
    else SWEEPS(SPH_CUBIC_SPLINE);
    return answer;
}
static int reset(void)
{
    const int columns = (int)controls[COLUMNS].value,
              rows = 2 * (int)(columns / sqrt(3.0)); /* even, for the period */
    const double rho = 25 / (36 * pi), pressure = 5 / (12 * pi), B0 = 1 / sqrt(4 * pi);
    int i, c, side;
    n = columns * rows;
    m = rho / n;
    for (side = 0; side < 2; side++) {
        gas *const g = &both[side];
        g->cleans = side;
        for (i = 0; i < n; i++) {
            const double x = (i % columns + 0.25 + 0.5 * (i / columns & 1)) / columns,
                         y = (i / columns + 0.5) / rows;
            for (c = 0; c < EVOLVED; c++) g->a[c][i] = g->rate[c][i] = g->before[c][i] = 0;
            g->x[i] = x;
            g->y[i] = y;
            g->a[VX][i] = -sin(2 * pi * y);
            g->a[VY][i] = sin(2 * pi * x);
            g->a[BX][i] = -B0 * sin(2 * pi * y);
            g->a[BY][i] = B0 * sin(4 * pi * x);
            g->a[U][i] = pressure / ((gamma53 - 1) * rho);
            g->a[ALPHA][i] = 0.1;
            g->h[i] = 1.2 * sqrt(m / rho);
        }
        LAB_TRY(rates(g));
    }
    lab_vortex.n = lab_vortex.n_moving = 2 * n;
    lab_vortex.size = 1.0 / columns;
    lab_vortex.time = dt = 0;
    return 0;
}
/* One step for both: leapfrog with one evaluation of the rates; everything but positions is predicted by
   Euler's rule and corrected by the trapezoidal one. */
static int step(void)
{
    int i, c, side;
    dt = 1;
    for (side = 0; side < 2; side++)
        for (i = 0; i < n; i++) {
            const gas *const g = &both[side];
            const double speed = g->cleans ? fmax(g->speed[i], g->ch) : g->speed[i];
            const double a2 = g->rate[VX][i] * g->rate[VX][i] + g->rate[VY][i] * g->rate[VY][i];
            dt = fmin(dt, 0.3 * fmin(g->h[i] / speed, 0.8 * sqrt(g->h[i] / sqrt(a2 + 1e-30))));
        }
    for (side = 0; side < 2; side++) {
        gas *const g = &both[side];
        for (i = 0; i < n; i++) {
            g->x[i] += dt * (g->a[VX][i] + 0.5 * dt * g->rate[VX][i]);
            g->y[i] += dt * (g->a[VY][i] + 0.5 * dt * g->rate[VY][i]);
            g->x[i] -= floor(g->x[i]);
            g->y[i] -= floor(g->y[i]);
            g->h[i] *= 1 + 0.5 * dt * g->div_v[i]; /* a good guess saves passes */
        }
        for (c = 0; c < EVOLVED; c++)
            for (i = 0; i < n; i++) {
                g->a[c][i] += dt * g->rate[c][i];
                g->before[c][i] = g->rate[c][i];
            }
        LAB_TRY(rates(g));
        for (c = 0; c < EVOLVED; c++)
            for (i = 0; i < n; i++) g->a[c][i] += 0.5 * dt * (g->rate[c][i] - g->before[c][i]);
    }
    lab_vortex.time += dt;
    return 0;
}

/* ---------------------------------------------------------------- what a host asks for */

static double x[BOTH], y[BOTH], h_div_B[BOTH], density[BOTH], strength[BOTH], pressure[BOTH];
static lab_field fields[FIELDS] = {{"h div B", h_div_B, -0.15, 0.15},
                                   {"density", density, 0.05, 0.5},
                                   {"|B|", strength, 0, 0.8},
                                   {"pressure", pressure, 0, 0.6}};
static lab_measure measures[MEASURES] = {{"mean h |div B| / mean |B|, without cleaning", 0},
                                         {"the same, with cleaning", 0},
                                         {"without / with", 0},
                                         {"magnetic energy, without", 0},
                                         {"magnetic energy, with", 0},
                                         {"time step", 0}};
static int look(void)
{
    int i, side;
    for (side = 0; side < 2; side++) {
        const gas *const g = &both[side];
        double divergence = 0, sum = 0, energy = 0;
        for (i = 0; i < n; i++) {
            const int to = side * n + i;
            x[to] = g->x[i] + side * apart;
            y[to] = g->y[i];
            h_div_B[to] = g->h[i] * g->div_B[i];
            density[to] = g->rho[i];
            strength[to] = sqrt(g->a[BX][i] * g->a[BX][i] + g->a[BY][i] * g->a[BY][i]);
            pressure[to] = g->p[i];
            divergence += fabs(h_div_B[to]);
            sum += strength[to];
            energy += m * strength[to] * strength[to] / (2 * g->rho[i]);
        }
        measures[LEFT + side].value = divergence / sum;
        measures[ENERGY_LEFT + side].value = energy;
    }
    measures[ERROR_RATIO].value =
        measures[RIGHT].value > 0 ? measures[LEFT].value / measures[RIGHT].value : 1;
    measures[DT].value = dt;
    return 0;
}
static int changed(int control) { return control == KERNEL || control == COLUMNS ? reset() : 0; }
lab_scene lab_vortex = {
    .name = "vortex",
    .title = "Orszag-Tang",
    .about = "A supersonic vortex of a magnetised gas, twice. On the left the divergence of B is left "
             "alone; on the right it is carried away as waves and damped (constrained hyperbolic "
             "divergence cleaning, Tricco & Price 2012).",
    .reset = reset,
    .step = step,
    .look = look,
    .changed = changed,
    .controls = controls,
    .fields = fields,
    .measures = measures,
    .n_controls = CONTROLS,
    .n_fields = FIELDS,
    .n_measures = MEASURES,
    .chosen = -1,
    .view = {-0.02, -0.02, 2.1, 1.16},
    .x = x,
    .y = y,
};
