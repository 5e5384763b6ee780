/* SPDX-License-Identifier: MIT
 *
 * clustering_viscous.h - hooks of a flow (clustering.h) with physical viscosity: that of Morris, Fox & Zhu 1997, JCP 136, 214; walls of Adami, Hu & Adams 2012, JCP 231, 7057; and the velocity cleaning of Tricco &
 * Price (7th SPHERIC workshop, Prato 2012, equations (29) to (39)).
 *
 *     viscous w;
 *     viscous_open(&w, &f, mu, body_force);      all particles are there; sets f.data, f.ghosts, f.force
 *     viscous_clean(&w, &f, ch);                 if divergence is to be cleaned: sets f.after
 *     ... flow_run(&f, t) ...
 *     viscous_close(&w);
 */
#ifndef CLUSTERING_VISCOUS_H
#define CLUSTERING_VISCOUS_H

#include "clustering.h"

typedef enum viscous_form { VISCOUS_MORRIS, VISCOUS_MONAGHAN_CLEARY, VISCOUS_ESPANOL_REVENGA } viscous_form;

/* What the hooks need beside the flow: one number for each particle in each array. */
typedef struct viscous {
    int form;              /* a viscous_form: Morris's */
    int slip;              /* 1: the fluid slips along the walls, which have one normal */
    double normal[2];
    double mu, body_force; /* along x */
    double ch;             /* of cleaning; 0: none */
    double *psi, *share, *wall_p, *wall_vx, *wall_vy, *vx, *vy, *ax, *ay;
} viscous;

/* ---------------------------------------------------------------- before the accelerations: psi and walls */

SPH_FN sph_index viscous_walls_by(sph_kernel k, const flow *f, sph_cloud targets)
{
    const viscous *const w = (const viscous *)f->data;
    sph_wall wall = {.share = sph_scalars_array(w->share),
                           .rho = sph_scalars_array(f->rho),
                           .p = sph_scalars_array(f->p),
                           .v = flow_velocities(f),
                           .velocity = flow_velocities(f),
                           .gravity = {f->gravity_x, f->gravity_y, 0}};
    const sph_wall_out out = {.p = w->wall_p, .v = sph_vector_out_separate(w->wall_vx, w->wall_vy, NULL)};
    if (w->slip) {
        wall.normal.x = sph_scalars_same(&w->normal[0]);
        wall.normal.y = sph_scalars_same(&w->normal[1]);
    }
    return sph_wall_adami(k, 2, targets, wall, out);
}
static inline long viscous_walls_part(void *data, long first, long last) /* of the ghosts */
{
    const flow *const f = (const flow *)data;
    const sph_cloud targets = flow_targets(f, f->n_fluid + first, f->n_fluid + last);
#define VISCOUS_WALLS(K) return viscous_walls_by(K, f, targets)
    FLOW_SWITCH_KERNEL(f->kernel, VISCOUS_WALLS)
#undef VISCOUS_WALLS
}
/* psi joins the pressure. Then pressure, and the density that belongs to it, of ghosts, and the velocity that makes the fluid stick to them; their own stays that of the wall. */
static inline void viscous_pressures(flow *f)
{
    viscous *const w = (viscous *)f->data;
    int i;
    for (i = 0; i < f->n_fluid && w->ch > 0; i++) f->p[i] += w->psi[i];
    if (f->n == f->n_fluid) return;
    expect((sph_index)threads_each(f->n - f->n_fluid, viscous_walls_part, f));
    for (i = f->n_fluid; i < f->n; i++) {
        f->p[i] = w->wall_p[i];
        f->rho[i] = sph_density_tait(f->p[i], f->state[f->phase[i]]);
    }
}

/* ---------------------------------------------------------------- after them: viscosity */

SPH_FN sph_index viscous_accelerations_by(sph_kernel k, const flow *f, sph_cloud targets)
{
    const viscous *const w = (const viscous *)f->data;
    const sph_fluid fluid = {.m = sph_scalars_array(f->m),
                             .rho = sph_scalars_array(f->rho),
                             .v = sph_vectors_separate(w->vx, w->vy, NULL),
                             .eta = 0.1};
    const sph_vector_out a = sph_vector_out_separate(w->ax, w->ay, NULL);
    if (w->form == VISCOUS_ESPANOL_REVENGA) { /* the bulk viscosity is mu */
        const sph_shear_bulk both = {sph_scalars_same(&w->mu), sph_scalars_same(&w->mu)};
        return sph_viscosity_mu_espanol_revenga(k, 2, targets, fluid, both, a);
    }
    if (w->form == VISCOUS_MONAGHAN_CLEARY)
        return sph_viscosity_mu_monaghan_cleary(k, 2, targets, fluid, sph_scalars_same(&w->mu), a);
    return sph_viscosity_mu_morris(k, 2, targets, fluid, sph_scalars_same(&w->mu), a);
}
static inline long viscous_accelerations_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const sph_cloud targets = flow_targets(f, first, last);
#define VISCOUS_ACCELERATIONS(K) return viscous_accelerations_by(K, f, targets)
    FLOW_SWITCH_KERNEL(f->kernel, VISCOUS_ACCELERATIONS)
#undef VISCOUS_ACCELERATIONS
}
static inline void viscous_forces(flow *f)
{
    const viscous *const w = (const viscous *)f->data;
    int i;
    for (i = 0; i < f->n; i++) {
        w->vx[i] = f->ghost[i] ? w->wall_vx[i] : f->vx[i];
        w->vy[i] = f->ghost[i] ? w->wall_vy[i] : f->vy[i];
    }
    if (w->mu > 0) expect((sph_index)threads_each(f->n_fluid, viscous_accelerations_part, f));
    for (i = 0; i < f->n_fluid; i++) {
        f->ax[i] += w->body_force + (w->mu > 0 ? w->ax[i] : 0);
        f->ay[i] += w->mu > 0 ? w->ay[i] : 0;
    }
}

/* ---------------------------------------------------------------- after the step: psi by the rate of density, damped on both sides */

static inline void viscous_psi(flow *f)
{
    const viscous *const w = (const viscous *)f->data;
    const double damping = exp(-0.5 * sph_cleaning_sigma(2) * w->ch * f->dt / f->h);
    const sph_cleaning_wave undamped = {.ch = w->ch, .h = f->h};
    int i;
    if (FLOW_FORM(f) != FLOW_CONTINUITY || !f->rate_after_kick) flow_continuity(f);
    for (i = 0; i < f->n_fluid; i++)
        w->psi[i] =
            damping * (damping * w->psi[i] + f->dt * sph_cleaning_rate_velocity(undamped, 0, f->rate[i]));
}

/* ---------------------------------------------------------------- */

static inline void viscous_open(viscous *w, flow *f, double mu, double body_force)
{
    double **const arrays[] = {&w->psi, &w->share, &w->wall_p, &w->wall_vx, &w->wall_vy,
                               &w->vx,  &w->vy,    &w->ax,     &w->ay};
    size_t a;
    int i;
    for (a = 0; a < sizeof arrays / sizeof *arrays; a++)
        *arrays[a] = (double *)need(NULL, (size_t)f->n, sizeof(double));
    for (i = 0; i < f->n; i++) {
        w->psi[i] = 0;
        w->share[i] = f->ghost[i] ? 0 : 1;
    }
    w->form = VISCOUS_MORRIS;
    w->slip = 0;
    w->normal[0] = 0;
    w->normal[1] = 1;
    w->mu = mu;
    w->body_force = body_force;
    w->ch = 0;
    f->data = w;
    f->ghosts = viscous_pressures;
    f->force = viscous_forces;
}
static inline void viscous_clean(viscous *w, flow *f, double ch)
{
    w->ch = ch;
    f->after = viscous_psi;
}
static inline void viscous_close(viscous *w)
{
    double *const arrays[] = {w->psi, w->share, w->wall_p, w->wall_vx, w->wall_vy,
                              w->vx,  w->vy,    w->ax,     w->ay};
    size_t a;
    for (a = 0; a < sizeof arrays / sizeof *arrays; a++) free(arrays[a]);
}

#endif
