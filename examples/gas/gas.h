/* SPDX-License-Identifier: MIT
 *
 * gas.h - an ideal gas without a field, P = (gamma - 1) rho u, in one to three dimensions: h follows the density,
 * the conductivity and the switch of the viscosity are choices. The drivers of this folder share it.
 *
 *     gas g = gas_new(dim, n, gamma);         then x, v, u, m, a guess of h, and box, free, the choices
 *     gas_start(&g);
 *     gas_run(&g, t_end, courant);
 *     gas_close(&g);
 *
 * A step is kick, drift, kick with v and u predicted for the rates: v' = v + dt a, u' = u + dt du/dt. With v and u
 * of the half step the energy would be wrong by 1e-3 instead of 1e-5. Cubic spline, eta = 1.2 unless a driver says
 * otherwise, beta = 2.
 */
#ifndef GAS_H
#define GAS_H

#ifndef SPH_CHECK
#define SPH_CHECK 0 /* every step looks for what is not finite */
#endif
#include "../../sph.h"
#include "../common/host.h"
#include "../common/report.h"
#include "../common/threads.h"

#include <math.h>
#include <string.h>

#ifndef GAS_KERNEL
#define GAS_KERNEL SPH_CUBIC_SPLINE
#define GAS_ETA 1.2
#endif

typedef enum gas_switch { GAS_CONSTANT, GAS_BALSARA, GAS_MORRIS, GAS_CULLEN, GAS_PHANTOM } gas_switch;
enum { X, Y, Z, VX, VY, VZ, PX, PY, PZ, U, PU, AX, AY, AZ, RATE_U, ALPHA, H, RHO, OMEGA, M, P, CS, V_SIG, DIV, DIV_BEFORE, CURL, SHEAR, RATIO, SPEED, VOLUME, REACH, ARRAYS };

typedef struct gas {
    int dim;
    sph_index n, free; /* particles; the first `free` of them move */
    double gamma, box[3], t, dt, alpha_u;
    int conductivity;
    gas_switch how;
    double alpha[2]; /* bounds of the viscosity; without a switch the second */
    search near;
    double *a[ARRAYS];
    unsigned char *status;
} gas;

static inline gas gas_new(int dim, sph_index n, double gamma)
{
    gas g;
    int k;
    memset(&g, 0, sizeof g);
    g.dim = dim;
    g.n = g.free = n;
    g.gamma = gamma;
    g.alpha[1] = g.alpha_u = 1;
    g.a[0] = (double *)need_zeros((size_t)ARRAYS * (size_t)n, sizeof(double));
    for (k = 1; k < ARRAYS; k++) g.a[k] = g.a[0] + (size_t)k * (size_t)n;
    g.status = (unsigned char *)need_zeros((size_t)n, 1);
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
    return sph_points_periodic(sph_points_separate(g->n, g->a[X], g->a[Y], g->a[Z]), g->box[0], g->box[1], g->box[2]);
}
static inline sph_scalars gas_field(const gas *g, int which) { return sph_scalars_array(g->a[which]); }
static inline sph_cloud gas_cloud(const gas *g, long first, long last)
{
    return sph_cloud_range(sph_cloud_of(gas_points(g), g->near.found.list, gas_field(g, H), gas_field(g, VOLUME)), (sph_index)first,
                           (sph_index)last);
}
static inline sph_gas gas_state(const gas *g)
{
    const sph_gas s = {.medium = {gas_field(g, M), gas_field(g, RHO), gas_field(g, OMEGA)},
                       .p = gas_field(g, P),
                       .u = gas_field(g, PU),
                       .cs = gas_field(g, CS),
                       .alpha = gas_field(g, ALPHA),
                       .v = vectors_of(g->a + PX, 3),
                       .beta = 2,
                       .alpha_u = g->alpha_u,
                       .conductivity = g->conductivity};
    return s;
}
static inline long gas_density_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_kernel k = GAS_KERNEL;
    const sph_density_options options = {gas_field(g, REACH), GAS_ETA, 1e-4};
    const sph_density_out out = {.h = g->a[H], .rho = g->a[RHO], .omega = g->a[OMEGA], .status = g->status};
    return WITH_DIM_1_2_3(sph_density_adaptive, k, g->dim, gas_cloud(g, first, last), gas_field(g, M), options, out);
}
static inline void gas_density(gas *g, sph_index last)
{
    sph_index i, failed = 1;
    while (failed > 0) { /* an h outgrew its list */
        for (i = 0; i < g->n; i++) g->a[REACH][i] = 1.04 * sph_kernel_support_ratio(GAS_KERNEL) * g->a[H][i];
        search_all(&g->near, g->dim, gas_points(g), gas_field(g, REACH), SPH_LARGER);
        failed = (sph_index)threads_each(last, gas_density_part, g);
        expect(failed);
        for (i = 0; i < last && failed > 0; i++)
            if (g->status[i] != SPH_OK && g->status[i] != SPH_LIST_TOO_SHORT) {
                fprintf(stderr, "\ndensity of particle %ld at t = %g: %s\n", (long)i, g->t, sph_status_text(g->status[i]));
                exit(1);
            }
    }
    for (i = 0; i < last; i++) g->a[VOLUME][i] = g->a[M][i] / g->a[RHO][i];
}
static inline long gas_rates_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_kernel k = GAS_KERNEL;
    const sph_gas_out out = {.acceleration = vectors_into(g->a + AX, 3), .rate_u = g->a[RATE_U], .v_sig = g->a[V_SIG]};
    return WITH_DIM_1_2_3(sph_gas_rates, k, g->dim, gas_cloud(g, first, last), gas_state(g), out);
}
static inline long gas_gradient_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_kernel k = GAS_KERNEL;
    const sph_velocity_gradient_out out = {.div = g->a[DIV], .curl = g->a[CURL], .shear = g->a[SHEAR]};
    return WITH_DIM_1_2_3(sph_velocity_gradient_cspm, k, g->dim, gas_cloud(g, first, last), vectors_of(g->a + PX, 3), out);
}
static inline long gas_shock_part(void *data, long first, long last)
{
    const gas *const g = (const gas *)data;
    const sph_kernel k = GAS_KERNEL;
    const sph_shock_out out = {.ratio = g->a[RATIO], .v_sig = g->a[SPEED]};
    return WITH_DIM_1_2_3(sph_shock_indicator, k, g->dim, gas_cloud(g, first, last), gas_state(g), gas_field(g, DIV), out);
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
        sph_shock shock = {(g->a[DIV][i] - g->a[DIV_BEFORE][i]) / dt, 0, g->a[H][i], g->a[CS][i], g->a[SPEED][i]};
        if (g->how == GAS_MORRIS) g->a[ALPHA][i] += dt * sph_viscosity_switch_rate(s, g->a[SPEED][i], g->a[H][i], f.div);
        else if (g->how == GAS_CULLEN) {
            shock.factor = sph_shock_factor_cullen_dehnen(f, g->a[RATIO][i]);
            g->a[ALPHA][i] = sph_viscosity_switch_after(s, shock, sph_viscosity_target_cullen_dehnen(s, shock), dt);
        } else {
            shock.factor = sph_shock_factor_phantom(f);
            g->a[ALPHA][i] = sph_viscosity_switch_after(s, shock, sph_viscosity_target_phantom(s, shock), dt);
        }
    }
    memcpy(g->a[DIV_BEFORE], g->a[DIV], (size_t)g->n * sizeof(double));
}
/* pressure and sound speed of the predicted u */
static inline void gas_pressure(gas *g)
{
    sph_index i;
    for (i = 0; i < g->n; i++) {
        g->a[P][i] = (g->gamma - 1) * g->a[RHO][i] * g->a[PU][i];
        g->a[CS][i] = sqrt(g->gamma * (g->gamma - 1) * fmax(g->a[PU][i], 0));
    }
}
/* rates of the predicted v and u */
static inline void gas_rates(gas *g, double dt)
{
    gas_density(g, g->free);
    gas_pressure(g);
    if (g->how != GAS_CONSTANT) gas_switches(g, dt);
    expect_all((sph_index)threads_each(g->free, gas_rates_part, g));
}
static inline void gas_start(gas *g)
{
    sph_index i;
    gas_density(g, g->n);
    for (i = 0; i < g->n; i++) g->a[ALPHA][i] = g->how == GAS_CONSTANT ? g->alpha[1] : g->alpha[0];
    memcpy(g->a[PX], g->a[VX], 3 * (size_t)g->n * sizeof(double));
    memcpy(g->a[PU], g->a[U], (size_t)g->n * sizeof(double));
    gas_rates(g, 0);
}
static inline void gas_run(gas *g, double end, double courant)
{
    while (g->t < end) {
        double dt = end - g->t;
        sph_index i;
        int k;
        for (i = 0; i < g->free; i++) dt = fmin(dt, courant * g->a[H][i] / g->a[V_SIG][i]);
        for (i = 0; i < g->free; i++) {
            for (k = 0; k < g->dim; k++) {
                g->a[PX + k][i] = g->a[VX + k][i] + dt * g->a[AX + k][i];
                g->a[VX + k][i] += 0.5 * dt * g->a[AX + k][i];
                g->a[X + k][i] += dt * g->a[VX + k][i];
            }
            g->a[PU][i] = g->a[U][i] + dt * g->a[RATE_U][i];
            g->a[U][i] += 0.5 * dt * g->a[RATE_U][i];
        }
        gas_rates(g, dt);
        for (i = 0; i < g->free; i++) {
            for (k = 0; k < g->dim; k++) g->a[VX + k][i] += 0.5 * dt * g->a[AX + k][i];
            g->a[U][i] += 0.5 * dt * g->a[RATE_U][i];
        }
        g->t += dt;
    }
}
static inline double gas_energy(const gas *g)
{
    double e = 0;
    sph_index i;
    for (i = 0; i < g->free; i++)
        e += g->a[M][i] * (g->a[U][i] + 0.5 * (g->a[VX][i] * g->a[VX][i] + g->a[VY][i] * g->a[VY][i] + g->a[VZ][i] * g->a[VZ][i]));
    return e;
}

/* ---- Gresho's vortex (Gresho & Chan 1990, IJNMF 11, 621), rho = 1: pressure balances rotation ---- */

static inline double gresho_speed(double r) { return r < 0.2 ? 5 * r : r < 0.4 ? 2 - 5 * r : 0; }
static inline double gresho_pressure(double r)
{
    if (r < 0.2) return 5 + 12.5 * r * r;
    if (r < 0.4) return 9 + 12.5 * r * r - 20 * r + 4 * log(r / 0.2);
    return 3 + 4 * log(2.0);
}

#endif
