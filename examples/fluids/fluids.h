/* SPDX-License-Identifier: MIT
 *
 * fluids.h - a weakly compressible liquid whose methods can be switched on one after the other, and what is
 * measured of it. The drivers of this folder share it. Particles, neighbours, pictures and the loop over steps
 * are those of the flow of ../papers/clustering.h; walls and physical viscosity those of clustering_viscous.h.
 *
 *     liquid l;
 *     liquid_open(&l, &method, dx, 1.6 * dx, c0, alpha);     rho0 = 1; everything else has a default
 *     for (...) flow_add(&l.f, x, y, 0, m);                  the liquid first
 *     for (...) flow_add_ghost(&l.f, x, y, 0, m);            then the walls
 *     liquid_start(&l, mu);
 *     flow_require(&l.f, flow_run(&l.f, 2.0));
 *     noise = liquid_noise(&l);
 *     liquid_close(&l);
 *
 * A step is kick, drift, kick: v += dt a / 2; x += dt v; rho += dt rate(x, v); p(rho); a(x, p); v += dt a / 2.
 * The pressures that make the forces belong to the positions where they act. With densities of the half step
 * they would lag behind, and sound would grow: that is the method `late`, which is here to be seen to fail.
 *
 * Pressure forces and density rates are those of Colagrossi & Landrini 2003 (sph_fluid_rates_colagrossi),
 * p = c0^2 (rho - rho0), the kernel is Wendland's C2. dt = 0.375 h / c0 unless the driver says otherwise.
 */
#ifndef FLUIDS_H
#define FLUIDS_H

#define FLOW_SWITCH_KERNEL(k, CALL) \
    (void)(k); \
    CALL(SPH_WENDLAND_C2); /* the only one here */
#include "../common/figure.h"
#include "../papers/clustering_viscous.h"

/* ================================================================ the command line */

typedef struct fluids_options {
    const char *out, *figures, *method; /* method: the only one; null: all */
    int full, vtk, quiet;
} fluids_options;
/* clang-format off */
#define FLUIDS_OPTIONS(o) \
    {"out", "folder of the result table (and of VTK files)", OPTION_TEXT, &(o).out, 0, 0}, \
    {"figures", "folder of the figures' data", OPTION_TEXT, &(o).figures, 0, 0}, \
    {"method", "this method alone, by its name in the names of files; any other: they are listed", OPTION_TEXT, &(o).method, 0, 0}, \
    {"full", "finer clouds, and three seeds of each run", OPTION_FLAG, &(o).full, 0, 0}, \
    {"vtk", "write 50 pictures of each run for ParaView", OPTION_FLAG, &(o).vtk, 0, 0}, \
    {"quiet", "no progress on the terminal", OPTION_FLAG, &(o).quiet, 0, 0}, THREADS_OPTION
/* clang-format on */
enum { FLUIDS_OPTION_COUNT = 7 };

/* ================================================================ methods */

typedef enum liquid_diffusion {
    LIQUID_NO_DIFFUSION,
    LIQUID_MOLTENI,
    LIQUID_ANTUONO,
    LIQUID_FOURTAKAS,
    /* EDAC (Ramachandran & Puri 2019, Comput. Fluids 179, 579): dp/dt = -rho c^2 div v + nu lap p with
       nu = 0.5 h c / 8. With p = c^2 (rho - rho0) it is LIQUID_MOLTENI with delta = 0.5 / 8. */
    LIQUID_EDAC
} liquid_diffusion;
typedef enum liquid_shift {
    LIQUID_NO_SHIFT,
    LIQUID_SKILLEN,    /* Lind 2012 with the strength of Skillen 2013, A = 2 */
    LIQUID_SUN,        /* Sun 2017 */
    LIQUID_SUN_MOVING, /* the same, and rho and v are moved along their gradients */
    LIQUID_SUN_2019,   /* a velocity, with what particles carry */
    LIQUID_TRANSPORT   /* Adami 2013, with density by summation; no free surface */
} liquid_shift;

typedef enum liquid_riemann {
    LIQUID_NO_RIEMANN,
    LIQUID_RIEMANN,        /* Zhang, Hu & Adams 2017, in place of artificial viscosity and density diffusion */
    LIQUID_RIEMANN_GRAVITY /* the same, with gravity taken out of the jump of pressure */
} liquid_riemann;

/* All zeros: none of them. */
typedef struct liquid_method {
    const char *name, *file; /* in tables; in names of files */
    liquid_diffusion diffusion;
    liquid_shift shift;
    liquid_riemann riemann;
    int tension;   /* 1: by the curvature (CSF), where the case has a tension; else by the stress (CSS) */
    int viscosity; /* physical, where the case has one: 1 + a viscous_form; 0: the form of the case */
    int inviscid; /* 1: without artificial viscosity, where the case has one */
    int late;     /* 1: pressures of densities that are half a step old, to be seen to fail */
} liquid_method;
/* by the same names in all cases */
/* clang-format off */
#define METHOD_CSS {.name = "CSS", .file = "css"}
#define METHOD_CSF {.name = "CSF", .file = "csf", .tension = 1}
#define METHOD_CSS_ANTUONO {.name = "CSS, Antuono", .file = "css_antuono", .diffusion = LIQUID_ANTUONO}
#define METHOD_CSS_SUN {.name = "CSS, Antuono, Sun 2017", .file = "css_sun", .diffusion = LIQUID_ANTUONO, .shift = LIQUID_SUN}
#define METHOD_PLAIN {.name = "plain", .file = "plain"}
#define METHOD_INVISCID {.name = "plain, alpha = 0", .file = "inviscid", .inviscid = 1}
#define METHOD_MORRIS {.name = "Morris", .file = "morris", .viscosity = 1 + VISCOUS_MORRIS}
#define METHOD_ANTUONO_MORRIS {.name = "Antuono, Morris", .file = "antuono_morris", .diffusion = LIQUID_ANTUONO, .viscosity = 1 + VISCOUS_MORRIS}
#define METHOD_CLEARY {.name = "Monaghan & Cleary", .file = "cleary", .viscosity = 1 + VISCOUS_MONAGHAN_CLEARY}
#define METHOD_ESPANOL {.name = "Espanol & Revenga, zeta = mu", .file = "espanol", .viscosity = 1 + VISCOUS_ESPANOL_REVENGA}
#define METHOD_LATE {.name = "plain, pressure half a step late", .file = "late", .late = 1}
#define METHOD_MOLTENI {.name = "Molteni & Colagrossi", .file = "molteni", .diffusion = LIQUID_MOLTENI}
#define METHOD_ANTUONO {.name = "Antuono", .file = "antuono", .diffusion = LIQUID_ANTUONO}
#define METHOD_ANTUONO_INVISCID {.name = "Antuono, alpha = 0", .file = "antuono_inviscid", .diffusion = LIQUID_ANTUONO, .inviscid = 1}
#define METHOD_FOURTAKAS {.name = "Fourtakas", .file = "fourtakas", .diffusion = LIQUID_FOURTAKAS}
#define METHOD_EDAC {.name = "EDAC", .file = "edac", .diffusion = LIQUID_EDAC}
#define METHOD_SKILLEN {.name = "Antuono, Lind & Skillen", .file = "skillen", .diffusion = LIQUID_ANTUONO, .shift = LIQUID_SKILLEN}
#define METHOD_SUN {.name = "Antuono, Sun 2017", .file = "sun", .diffusion = LIQUID_ANTUONO, .shift = LIQUID_SUN}
#define METHOD_SUN_ALONE {.name = "Sun 2017", .file = "sun_alone", .shift = LIQUID_SUN}
#define METHOD_SUN_MOVING {.name = "Antuono, Sun 2017, fields moved", .file = "sun_moving", .diffusion = LIQUID_ANTUONO, .shift = LIQUID_SUN_MOVING}
#define METHOD_SUN_2019 {.name = "Antuono, Sun 2019", .file = "sun_2019", .diffusion = LIQUID_ANTUONO, .shift = LIQUID_SUN_2019}
#define METHOD_TRANSPORT {.name = "transport velocity", .file = "transport", .shift = LIQUID_TRANSPORT}
#define METHOD_RIEMANN {.name = "Riemann", .file = "riemann", .riemann = LIQUID_RIEMANN, .inviscid = 1}
#define METHOD_RIEMANN_GRAVITY {.name = "Riemann, gravity out of the jump", .file = "riemann_gravity", .riemann = LIQUID_RIEMANN_GRAVITY, .inviscid = 1}
#define METHOD_RIEMANN_SUN {.name = "Riemann, Sun 2017", .file = "riemann_sun", .riemann = LIQUID_RIEMANN, .shift = LIQUID_SUN, .inviscid = 1}
/* clang-format on */

/* ================================================================ the liquid */

typedef struct liquid {
    viscous w; /* the first member: f.data leads to both */
    flow f;
    const liquid_method *method;
    double c0, speed; /* speed: of the flow, for shifting; 0: the largest at the time */
    int form;    /* of physical viscosity, a viscous_form: Morris's */
    int surface; /* 1: there is a free surface, which shifting must know of */
    int started;
    void (*rated)(flow *); /* changes the rates of density; null: nothing does */
    /* of each particle: gradient of rho or of another field; shift, or its velocity, or the velocity that
       moves a particle; least eigenvalue and normal; accelerations of a transport velocity, or of a shift; and what is
       needed for a moment, one number more than particles */
    double *gradient[2], *shift[2], *eigenvalue, *normal[2], *background[2], *stress[2], *scratch, *memory;
} liquid;
static inline liquid *liquid_of(const flow *f) { return (liquid *)f->data; }

/* ---------------------------------------------------------------- sweeps, in parts for threads */

static inline void liquid_each(flow *f, threads_part part)
{
    expect_all((sph_index)threads_each(f->n_fluid, part, f));
}

static inline sph_fluid liquid_fluid(const flow *f)
{
    sph_fluid s = {.m = sph_scalars_array(f->m),
                   .rho = sph_scalars_array(f->rho),
                   .p = sph_scalars_array(f->p),
                   .c = sph_scalars_array(f->c),
                   .v = flow_velocities(f)};
    return s;
}
static inline sph_cloud liquid_targets(const flow *f, long first, long last) /* with volumes */
{
    sph_cloud targets = flow_targets(f, first, last);
    targets.volume = sph_scalars_array(f->volume);
    return targets;
}
static inline void liquid_volumes(flow *f)
{
    int i;
    for (i = 0; i < f->n; i++) f->volume[i] = f->m[i] / f->rho[i];
}
/* the gradient of l->scratch, a copy of rho or of a component of v */
static inline long liquid_gradient_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_derivatives_out out = {.gx = l->gradient[0], .gy = l->gradient[1]};
    return sph_gradient_cspm(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), sph_scalars_array(l->scratch),
                             out);
}
static inline long liquid_rate_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_cloud targets = liquid_targets(f, first, last);
    const sph_scalar_out out = sph_scalar_out_array(f->rate, NULL);
    sph_diffusion d = {.fluid = liquid_fluid(f),
                       .tait = f->state[0],
                       .share = sph_scalars_array(l->w.share),
                       .gradient = vectors_of(l->gradient, 2),
                       .gravity = {f->gravity_x, f->gravity_y, 0}};
    if (l->method->diffusion == LIQUID_ANTUONO)
        return sph_density_diffusion_antuono(SPH_WENDLAND_C2, 2, targets, d, out);
    if (l->method->diffusion == LIQUID_FOURTAKAS)
        return sph_density_diffusion_fourtakas(SPH_WENDLAND_C2, 2, targets, d, out);
    if (l->method->diffusion == LIQUID_EDAC) d.delta = 0.5 / 8;
    return sph_density_diffusion_molteni(SPH_WENDLAND_C2, 2, targets, d, out);
}
static inline long liquid_riemann_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_fluid_out out = {.acceleration = flow_accelerations(f), .rate = f->rate};
    sph_riemann_options options = {0, {0, 0, 0}};
    if (l->method->riemann == LIQUID_RIEMANN_GRAVITY) {
        options.gravity.x = f->gravity_x;
        options.gravity.y = f->gravity_y;
    }
    return sph_fluid_rates_riemann(SPH_WENDLAND_C2, 2, flow_targets(f, first, last), liquid_fluid(f), options,
                                   out);
}
static inline long liquid_surface_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_surface_out out = {.eigenvalue = l->eigenvalue, .normal = vectors_into(l->normal, 2)};
    sph_free_surface(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), out);
    return 0; /* a drop of spray has no normal, and is not moved */
}
static inline double liquid_fastest(const flow *f)
{
    double most = 0;
    int i;
    for (i = 0; i < f->n_fluid; i++) most = fmax(most, f->vx[i] * f->vx[i] + f->vy[i] * f->vy[i]);
    return sqrt(most);
}
static inline long liquid_shift_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    sph_shift s = {.strength = sph_scalars_array(l->scratch)};
    if (l->surface) {
        s.eigenvalue = sph_scalars_array(l->eigenvalue);
        s.normal = vectors_of(l->normal, 2);
    }
    if (l->method->shift != LIQUID_SKILLEN) {
        s.tensile = 0.2;
        s.spacing = f->dref / f->h;
    }
    if (l->method->shift == LIQUID_SUN_2019) s.longest = 0.5 * f->dt * l->scratch[f->n];
    return sph_shift_displacement(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), s,
                                  vectors_into(l->shift, 2));
}
static inline long liquid_carried_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_fluid_out out = {.acceleration = vectors_into(l->stress, 2), .rate = l->scratch};
    return sph_shift_rates(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), liquid_fluid(f),
                           vectors_of(l->shift, 2), out);
}
static inline long liquid_transport_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_transport_out out = {.background = vectors_into(l->background, 2),
                                   .stress = vectors_into(l->stress, 2)};
    return sph_transport_adami(SPH_WENDLAND_C2, 2, flow_targets(f, first, last), liquid_fluid(f),
                               vectors_of(l->shift, 2), l->c0 * l->c0, out);
}

/* ---------------------------------------------------------------- a step */

/* adds what is in `scratch` and `stress` */
static inline void liquid_add_carried(flow *f, int to_density)
{
    const liquid *const l = liquid_of(f);
    int i;
    liquid_volumes(f);
    liquid_each(f, liquid_carried_part);
    for (i = 0; i < f->n_fluid; i++)
        if (to_density) f->rate[i] += l->scratch[i];
        else {
            f->ax[i] += l->stress[0][i];
            f->ay[i] += l->stress[1][i];
        }
}
static inline void liquid_forces(flow *f)
{
    const liquid *const l = liquid_of(f);
    int i;
    flow_pressure(f);
    f->ghosts(f);
    if (l->method->riemann) liquid_each(f, liquid_riemann_part);
    else expect_all(flow_rates(f));
    f->force(f);
    if (l->method->shift == LIQUID_SUN_2019) liquid_add_carried(f, 0);
    if (l->method->shift == LIQUID_TRANSPORT) {
        liquid_each(f, liquid_transport_part);
        for (i = 0; i < f->n_fluid; i++) {
            f->ax[i] += l->stress[0][i];
            f->ay[i] += l->stress[1][i];
        }
    }
}
static inline void liquid_kick(flow *f, double dt)
{
    int i;
    for (i = 0; i < f->n_fluid; i++) {
        f->vx[i] += dt * (f->ax[i] + f->gravity_x);
        f->vy[i] += dt * (f->ay[i] + f->gravity_y);
    }
}
/* drho/dt into f->rate, or the density itself where it is a sum */
static inline void liquid_rate(flow *f)
{
    liquid *const l = liquid_of(f);
    if (l->method->shift == LIQUID_TRANSPORT) {
        expect_all(flow_density(f));
        return;
    }
    if (l->method->riemann) liquid_each(f, liquid_riemann_part);
    else if (l->method->diffusion == LIQUID_NO_DIFFUSION) flow_continuity(f);
    else {
        liquid_volumes(f);
        if (l->method->diffusion == LIQUID_ANTUONO) {
            memcpy(l->scratch, f->rho, (size_t)f->n * sizeof *f->rho);
            expect((sph_index)threads_each(f->n_fluid, liquid_gradient_part, f)); /* 0 in spray */
        }
        liquid_each(f, liquid_rate_part);
    }
    if (l->method->shift == LIQUID_SUN_2019) liquid_add_carried(f, 1);
}
static inline void liquid_density(flow *f, double dt)
{
    int i;
    for (i = 0; i < f->n_fluid && liquid_of(f)->method->shift != LIQUID_TRANSPORT; i++)
        f->rho[i] += dt * f->rate[i];
}
/* l->shift, a displacement without more ado */
static inline long liquid_even_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const liquid *const l = liquid_of(f);
    const sph_shift s = {.strength = sph_scalars_array(l->scratch)};
    return sph_shift_displacement(SPH_WENDLAND_C2, 2, liquid_targets(f, first, last), s,
                                  vectors_into(l->shift, 2));
}
static inline void liquid_shift_by(flow *f, double strength)
{
    liquid *const l = liquid_of(f);
    int i;
    for (i = 0; i < f->n; i++) l->scratch[i] = strength;
    liquid_each(f, liquid_even_part);
}
/* l->shift, a displacement */
static inline void liquid_find_shift(flow *f)
{
    liquid *const l = liquid_of(f);
    const double fastest = l->speed > 0 ? l->speed : liquid_fastest(f);
    int i;
    liquid_volumes(f);
    if (l->surface) liquid_each(f, liquid_surface_part);
    for (i = 0; i < f->n_fluid; i++)
        l->scratch[i] =
            l->method->shift == LIQUID_SKILLEN
                ? sph_shift_strength_skillen(2, f->h, f->dt * sqrt(f->vx[i] * f->vx[i] + f->vy[i] * f->vy[i]))
                : sph_shift_strength_sun(f->h, f->dt * fastest, f->h);
    l->scratch[f->n] = fastest;
    liquid_each(f, liquid_shift_part);
}
/* field += dx . grad field */
static inline void liquid_move_field(flow *f, double *field)
{
    liquid *const l = liquid_of(f);
    int i;
    memcpy(l->scratch, field, (size_t)f->n * sizeof *field);
    expect((sph_index)threads_each(f->n_fluid, liquid_gradient_part, f));
    for (i = 0; i < f->n_fluid; i++)
        field[i] += l->shift[0][i] * l->gradient[0][i] + l->shift[1][i] * l->gradient[1][i];
}
static inline void liquid_shift_particles(flow *f)
{
    liquid *const l = liquid_of(f);
    int i;
    liquid_find_shift(f);
    if (l->method->shift == LIQUID_SUN_MOVING) {
        liquid_move_field(f, f->rho);
        liquid_move_field(f, f->vx);
        liquid_move_field(f, f->vy);
    }
    for (i = 0; i < f->n_fluid; i++) {
        f->x[i] += l->shift[0][i];
        f->y[i] += l->shift[1][i];
    }
}
/* The velocity of shifting, into l->shift. */
static inline void liquid_shift_velocity(flow *f)
{
    liquid *const l = liquid_of(f);
    int i;
    liquid_find_shift(f);
    for (i = 0; i < f->n_fluid; i++) {
        l->shift[0][i] /= f->dt;
        l->shift[1][i] /= f->dt;
    }
}
/* x += dt (v, or the velocity that moves particles) */
static inline void liquid_drift(flow *f)
{
    liquid *const l = liquid_of(f);
    const liquid_shift shift = l->method->shift;
    int i;
    for (i = 0; i < f->n_fluid; i++) {
        double ux = f->vx[i], uy = f->vy[i];
        if (shift == LIQUID_SUN_2019) {
            ux += l->shift[0][i];
            uy += l->shift[1][i];
        }
        if (shift == LIQUID_TRANSPORT) {
            ux += 0.5 * f->dt * l->background[0][i];
            uy += 0.5 * f->dt * l->background[1][i];
            l->shift[0][i] = ux;
            l->shift[1][i] = uy;
        }
        f->x[i] += f->dt * ux;
        f->y[i] += f->dt * uy;
    }
}
static inline void liquid_step(flow *f)
{
    liquid *const l = liquid_of(f);
    const liquid_shift shift = l->method->shift;
    if (!l->started) {
        flow_neighbours(f);
        if (shift == LIQUID_SUN_2019) liquid_shift_velocity(f);
        if (shift == LIQUID_TRANSPORT) {
            memcpy(l->shift[0], f->vx, (size_t)f->n * sizeof *f->vx);
            memcpy(l->shift[1], f->vy, (size_t)f->n * sizeof *f->vy);
            expect_all(flow_density(f));
        }
        liquid_forces(f);
        l->started = 1;
    }
    liquid_kick(f, 0.5 * f->dt);
    if (!flow_healthy(f)) return;
    liquid_drift(f);
    flow_neighbours(f);
    if (shift == LIQUID_SUN_2019) liquid_shift_velocity(f);
    liquid_rate(f);
    if (l->rated) l->rated(f);
    liquid_density(f, l->method->late ? 0.5 * f->dt : f->dt);
    if (!flow_healthy(f)) return;
    liquid_forces(f);
    if (l->method->late) liquid_density(f, 0.5 * f->dt);
    liquid_kick(f, 0.5 * f->dt);
    if (shift == LIQUID_SKILLEN || shift == LIQUID_SUN || shift == LIQUID_SUN_MOVING) liquid_shift_particles(f);
    f->steps++;
}

/* alpha: of the artificial viscosity */
static inline void liquid_open(liquid *l, const liquid_method *method, double dx, double h, double c0,
                               double alpha)
{
    memset(l, 0, sizeof *l);
    flow_open(&l->f, method->file, SPH_WENDLAND_C2, dx, h);
    l->method = method;
    l->c0 = c0;
    l->f.state[0].rho0 = 1;
    l->f.state[0].c = c0;
    l->f.form = method->shift == LIQUID_TRANSPORT ? FLOW_NUMBER : FLOW_CONTINUITY;
    l->f.rate_after_kick = 1;
    l->f.alpha = method->inviscid ? 0 : alpha;
    l->f.dt = 0.375 * h / c0;
    l->f.step = liquid_step;
}
/* All particles are there. mu: physical viscosity, may be 0. */
static inline void liquid_start(liquid *l, double mu, const fluids_options *o)
{
    double **const arrays[] = {&l->gradient[0], &l->gradient[1], &l->shift[0],      &l->shift[1],
                               &l->eigenvalue,      &l->normal[0],   &l->normal[1],     &l->background[0],
                               &l->background[1], &l->stress[0], &l->stress[1],     &l->scratch};
    enum { ARRAYS = sizeof arrays / sizeof *arrays };
    const size_t n = (size_t)l->f.n + 1;
    size_t a;
    l->memory = (double *)need_zeros(ARRAYS * n, sizeof(double));
    for (a = 0; a < ARRAYS; a++) *arrays[a] = l->memory + a * n;
    viscous_open(&l->w, &l->f, mu, 0);
    l->w.form = l->method->viscosity ? l->method->viscosity - 1 : l->form;
    l->f.quiet = o->quiet;
    l->f.vtk = o->vtk ? o->out : NULL;
}
static inline void liquid_close(liquid *l)
{
    viscous_close(&l->w);
    free(l->memory);
    flow_close(&l->f);
}
/* The pressure p, the density that belongs to it, and the mass of a volume dx^2. */
static inline void liquid_set_pressure(liquid *l, int i, double p)
{
    l->f.p[i] = p;
    l->f.rho[i] = sph_density_tait(p, l->f.state[0]);
    l->f.m[i] = l->f.rho[i] * l->f.dref * l->f.dref;
    l->f.inverse_mass[i] = 1 / l->f.m[i];
}
/* at rest */
static inline int liquid_add(liquid *l, double x, double y, double p)
{
    const int i = flow_add(&l->f, x, y, 0, 1);
    liquid_set_pressure(l, i, p);
    return i;
}
/* Walls around 0 ... columns, 0 ... rows (in dx), as far as a support reaches, without a lid. */
static inline void liquid_add_tank(liquid *l, int columns, int rows)
{
    const double dx = l->f.dref;
    const int layers = (int)ceil(sph_kernel_support_ratio(l->f.kernel) * l->f.h / dx - 1e-9);
    int i, j;
    for (j = -layers; j < rows; j++)
        for (i = -layers; i < columns + layers; i++)
            if (j < 0 || i < 0 || i >= columns)
                flow_add_ghost(&l->f, (i + 0.5) * dx, (j + 0.5) * dx, 0, dx * dx);
}

/* ================================================================ measures */

static inline double liquid_mass(const liquid *l)
{
    double m = 0;
    int i;
    for (i = 0; i < l->f.n_fluid; i++) m += l->f.m[i];
    return m;
}
/* Height of the centre of mass. */
static inline double liquid_height(const liquid *l)
{
    double sum = 0;
    int i;
    for (i = 0; i < l->f.n_fluid; i++) sum += l->f.m[i] * l->f.y[i];
    return sum / liquid_mass(l);
}

/* rms over the liquid of p minus the value there of the linear least-squares fit to the pressures of the
   neighbours in the liquid, weighted by W (sph_interpolate_mls: a particle is not in its own list). */
static inline double liquid_noise(liquid *l)
{
    flow *const f = &l->f;
    sph_points liquid_alone = flow_points(f);
    const double reach = sph_kernel_support_ratio(f->kernel) * f->h;
    unsigned char *const status = (unsigned char *)need(NULL, (size_t)f->n, 1);
    const sph_interpolation_options options = {.conditioning_min = 1e-3};
    const sph_interpolation_out out = {.value = l->scratch, .status = status};
    sph_sources sources;
    search near = {0};
    double sum = 0;
    int i, counted = 0;
    liquid_volumes(f);
    liquid_alone.n = f->n_fluid;
    search_all(&near, 2, liquid_alone, sph_scalars_same(&reach), SPH_GATHER);
    sources.points = liquid_alone;
    sources.volume = sph_scalars_array(f->volume);
    expect(sph_interpolate_mls(SPH_WENDLAND_C2, 2,
                               sph_cloud_of(liquid_alone, near.found.list, sph_scalars_same(&f->h), sph_scalars_none()),
                               sources, sph_scalars_array(f->p), options, out));
    for (i = 0; i < f->n_fluid; i++)
        if (status[i] == SPH_OK) {
            sum += (f->p[i] - l->scratch[i]) * (f->p[i] - l->scratch[i]);
            counted++;
        }
    search_close(&near);
    free(status);
    return counted ? sqrt(sum / counted) : 0;
}

/* ================================================================ methods side by side */

enum { LIQUID_FIGURES = 6 };
/* A method in a case: known[k], of an earlier trial, is what its figure k was there; 0: nothing is known. */
typedef struct liquid_trial {
    liquid_method method;
    double known[LIQUID_FIGURES];
    int full; /* 1: with -full only, or if it is asked for */
} liquid_trial;

/* A case: what its figures are, and how one method gets them. seed: of a displacement of all particles by up
   to 2 % of their distance; 0: none. The run ends with liquid_end. */
typedef struct liquid_case {
    const char *item;
    int figures;
    const char *quantity[LIQUID_FIGURES];
    double factor[LIQUID_FIGURES]; /* by which a figure may differ from what is known; flows are chaotic */
    void (*run)(const liquid_method *m, int seed, const fluids_options *o, double *figure);
    int random; /* 1: the start is random. Seeds 1, 2, 3, always; a figure is the mean over them */
} liquid_case;

enum { LIQUID_SEEDS = 3, LIQUID_METHODS = 16 };
/* What the methods have shown: figures, those of each seed if there are seeds, and CPU time of a particle and step
   in microseconds. */
typedef struct liquid_results {
    double figure[LIQUID_METHODS][LIQUID_FIGURES], seen[LIQUID_METHODS][LIQUID_SEEDS][LIQUID_FIGURES],
        cost[LIQUID_METHODS];
} liquid_results;
static double liquid_cost; /* of the run that has ended last */

static inline void liquid_shake(liquid *l, int seed)
{
    pcg32 g;
    int i;
    if (seed <= 0) return;
    pcg32_seed(&g, (uint64_t)seed, 1);
    for (i = 0; i < l->f.n_fluid; i++) {
        l->f.x[i] += 0.04 * (pcg32_uniform(&g) - 0.5) * l->f.dref;
        l->f.y[i] += 0.04 * (pcg32_uniform(&g) - 0.5) * l->f.dref;
    }
}
/* An even cloud without a direction, in a periodic box: particles moved at random by up to 0.2 dx, and then
   shifted 0.4 h^2 G again and again. Volumes are equal. */
static inline void liquid_pack(liquid *l, int seed, int steps)
{
    flow *const f = &l->f;
    pcg32 g;
    int i, s;
    pcg32_seed(&g, (uint64_t)seed, 2);
    for (i = 0; i < f->n; i++) {
        f->x[i] += 0.4 * (pcg32_uniform(&g) - 0.5) * f->dref;
        f->y[i] += 0.4 * (pcg32_uniform(&g) - 0.5) * f->dref;
        f->volume[i] = f->dref * f->dref;
    }
    for (s = 0; s < steps; s++) {
        flow_neighbours(f);
        liquid_shift_by(f, 0.4 * f->h * f->h);
        for (i = 0; i < f->n; i++) {
            f->x[i] += l->shift[0][i];
            f->y[i] += l->shift[1][i];
        }
    }
}
/* Picture of the end, and memory. */
static inline void liquid_end(liquid *l, const char *what, int seed, const fluids_options *o)
{
    char name[96];
    snprintf(name, sizeof name, "fluids_%s_%s", what, l->method->file);
    if (seed == 0) flow_snapshot(&l->f, o->figures, name);
    liquid_cost = flow_microseconds(&l->f);
    liquid_close(l);
}

static inline int liquid_wanted(const liquid_trial *t, const fluids_options *o)
{
    return o->method ? strcmp(t->method.file, o->method) == 0 : o->full || !t->full;
}
/* The row 'three seeds': the range of `value`, one for each seed, `stride` numbers apart. */
static inline void liquid_range(report *r, const char *item, const char *setting, const char *quantity,
                                const double *value, int stride)
{
    double low = value[0], high = value[0];
    char text[64];
    int s;
    for (s = 1; s < LIQUID_SEEDS; s++) {
        low = fmin(low, value[s * stride]);
        high = fmax(high, value[s * stride]);
    }
    snprintf(text, sizeof text, "%.4g to %.4g", low, high);
    report_row(r, item, setting, quantity, NULL, text, "three seeds", NULL, REPORT_INFO);
}
/* A row for each figure of each method; with -full, and if the start is random, the range over seeds as well. Then
   the table: a line for each method. */
static inline void liquid_compare(report *r, const liquid_case *c, const liquid_trial *trial, int count,
                                  const fluids_options *o, liquid_results *x)
{
    int t, k, s, tried = 0;
    for (t = 0; t < count; t++) {
        const liquid_method *const m = &trial[t].method;
        const int seeds = c->random || o->full ? LIQUID_SEEDS : 0;
        if (!liquid_wanted(&trial[t], o)) continue;
        tried++;
        if (!c->random) {
            c->run(m, 0, o, x->figure[t]);
            x->cost[t] = liquid_cost;
        }
        for (s = 0; s < seeds; s++) {
            c->run(m, s + 1, o, x->seen[t][s]);
            if (!c->random) continue;
            x->cost[t] = s ? x->cost[t] + liquid_cost / LIQUID_SEEDS : liquid_cost / LIQUID_SEEDS;
            for (k = 0; k < c->figures; k++)
                x->figure[t][k] = (s ? x->figure[t][k] : 0) + x->seen[t][s][k] / LIQUID_SEEDS;
        }
        for (k = 0; k < c->figures; k++) {
            const double known = trial[t].known[k], a = known / c->factor[k], b = known * c->factor[k];
            if (known != 0)
                report_range(report_beside(r, REPORT_REGRESSION), c->item, m->name, c->quantity[k], known,
                             x->figure[t][k], fmin(a, b), fmax(a, b));
            else report_info(r, c->item, m->name, c->quantity[k], x->figure[t][k]);
            if (seeds) liquid_range(r, c->item, m->name, c->quantity[k], &x->seen[t][0][k], LIQUID_FIGURES);
        }
        report_info(r, c->item, m->name, "CPU time of a particle and step [us]", x->cost[t]);
    }
    if (tried == 0) {
        fprintf(stderr, "option -method: '%s' is none of", o->method);
        for (t = 0; t < count; t++) fprintf(stderr, " %s", trial[t].method.file);
        fprintf(stderr, "\n");
        exit(2);
    }
    printf("\n%-34s", c->item);
    for (k = 0; k < c->figures; k++) printf(" %18.18s", c->quantity[k]);
    printf(" %8s\n", "cost");
    for (t = 0; t < count; t++) {
        if (!liquid_wanted(&trial[t], o)) continue;
        printf("%-34s", trial[t].method.name);
        for (k = 0; k < c->figures; k++) printf(" %18.4g", x->figure[t][k]);
        if (o->method) printf(" %8s\n", "");
        else printf(" %8.2f\n", x->cost[t] / x->cost[0]);
    }
}

#endif
