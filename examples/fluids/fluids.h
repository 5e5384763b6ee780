/* SPDX-License-Identifier: MIT
 *
 * fluids.h - a weakly compressible liquid whose methods can be switched on one after the other, and what is
 * measured of it. The drivers of this folder share it. Particles, neighbours, pictures and the loop over steps
 * are those of the flow of ../papers/clustering.h; walls and physical viscosity those of clustering_viscous.h.
 *
 *     liquid l;
 *     liquid_open(&l, &method, dx, 1.6 * dx, c0);            rho0 = 1; everything else has a default
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
 * p = c0^2 (rho - rho0), the kernel is Wendland's C2. dt = 0.25 h / c0 unless the driver says otherwise.
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
    const char *out, *figures;
    int full, vtk, quiet;
} fluids_options;
/* clang-format off */
#define FLUIDS_OPTIONS(o) \
    {"out", "folder of the result table (and of VTK files)", OPTION_TEXT, &(o).out, 0, 0}, \
    {"figures", "folder of the figures' data", OPTION_TEXT, &(o).figures, 0, 0}, \
    {"full", "finer clouds, and three seeds of each run", OPTION_FLAG, &(o).full, 0, 0}, \
    {"vtk", "write 50 pictures of each run for ParaView", OPTION_FLAG, &(o).vtk, 0, 0}, \
    {"quiet", "no progress on the terminal", OPTION_FLAG, &(o).quiet, 0, 0}, THREADS_OPTION
/* clang-format on */
enum { FLUIDS_OPTION_COUNT = 6 };

/* ================================================================ methods */

enum { LIQUID_NO_DIFFUSION, LIQUID_EDAC };

/* All zeros: none of them. */
typedef struct liquid_method {
    const char *name, *file; /* in tables; in names of files */
    int diffusion;           /* of the density */
    int late;                /* 1: pressures of the half step, to be seen to fail */
} liquid_method;

/* ================================================================ the liquid */

typedef struct liquid {
    viscous w; /* the first member: f.data leads to both */
    flow f;
    const liquid_method *method;
    double c0, *diffused; /* diffused: of each particle */
    int started;
} liquid;
static inline liquid *liquid_of(const flow *f) { return (liquid *)f->data; }

static inline void liquid_forces(flow *f)
{
    flow_pressure(f);
    f->ghosts(f);
    expect_all(flow_rates(f));
    f->force(f);
}
static inline void liquid_kick(flow *f, double dt)
{
    int i;
    for (i = 0; i < f->n_fluid; i++) {
        f->vx[i] += dt * (f->ax[i] + f->gravity_x);
        f->vy[i] += dt * (f->ay[i] + f->gravity_y);
    }
}

/* EDAC (Ramachandran & Puri 2019, Comput. Fluids 179, 579): dp/dt = -rho c^2 div v + nu lap p with nu = 0.5 h c / 8.
   With p = c^2 (rho - rho0) the second term is a diffusion of rho. */
static inline long liquid_edac_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    sph_cloud targets = flow_targets(f, first, last);
    targets.volume = sph_scalars_array(f->volume);
    return sph_laplacian_brookshaw(SPH_WENDLAND_C2, 2, targets, sph_scalars_array(f->rho),
                                   sph_scalar_out_array(liquid_of(f)->diffused, NULL));
}
static inline void liquid_diffuse(flow *f)
{
    liquid *const l = liquid_of(f);
    int i;
    if (l->method->diffusion == LIQUID_NO_DIFFUSION) return;
    for (i = f->n_fluid; i < f->n; i++) f->volume[i] = 0; /* none between liquid and walls */
    expect_all((sph_index)threads_each(f->n_fluid, liquid_edac_part, f));
    for (i = 0; i < f->n_fluid; i++) f->rate[i] += 0.5 * f->h * l->c0 / 8 * l->diffused[i];
}
static inline void liquid_density(flow *f)
{
    int i;
    flow_continuity(f);
    liquid_diffuse(f);
    for (i = 0; i < f->n_fluid; i++) f->rho[i] += f->dt * f->rate[i];
}
static inline void liquid_drift(flow *f, double dt)
{
    int i;
    for (i = 0; i < f->n_fluid; i++) {
        f->x[i] += dt * f->vx[i];
        f->y[i] += dt * f->vy[i];
    }
}
static inline void liquid_step(flow *f)
{
    liquid *const l = liquid_of(f);
    if (!l->started) {
        flow_neighbours(f);
        liquid_forces(f);
        l->started = 1;
    }
    liquid_kick(f, 0.5 * f->dt);
    if (!flow_healthy(f)) return;
    if (l->method->late) { /* rho of the half step, at the positions there */
        liquid_drift(f, 0.5 * f->dt);
        flow_neighbours(f);
        liquid_density(f);
        liquid_drift(f, 0.5 * f->dt);
        flow_neighbours(f);
    } else {
        liquid_drift(f, f->dt);
        flow_neighbours(f);
        liquid_density(f);
    }
    liquid_forces(f);
    liquid_kick(f, 0.5 * f->dt);
    f->steps++;
}

static inline void liquid_open(liquid *l, const liquid_method *method, double dx, double h, double c0)
{
    memset(l, 0, sizeof *l);
    flow_open(&l->f, method->file, SPH_WENDLAND_C2, dx, h);
    l->method = method;
    l->c0 = c0;
    l->f.state[0].rho0 = 1;
    l->f.state[0].c = c0;
    l->f.form = FLOW_CONTINUITY;
    l->f.rate_after_kick = 1;
    l->f.alpha = 0;
    l->f.dt = 0.25 * h / c0;
    l->f.step = liquid_step;
}
/* All particles are there. mu: physical viscosity, may be 0. */
static inline void liquid_start(liquid *l, double mu, const fluids_options *o)
{
    viscous_open(&l->w, &l->f, mu, 0);
    l->diffused = (double *)need_zeros((size_t)l->f.n, sizeof *l->diffused);
    l->f.quiet = o->quiet;
    l->f.vtk = o->vtk ? o->out : NULL;
}
static inline void liquid_close(liquid *l)
{
    viscous_close(&l->w);
    free(l->diffused);
    flow_close(&l->f);
}
/* x, y, and at rest the pressure p: with the density that belongs to it, and the mass of a volume dx^2 */
static inline int liquid_add(liquid *l, double x, double y, double p)
{
    const double rho = sph_density_tait(p, l->f.state[0]);
    const int i = flow_add(&l->f, x, y, 0, rho * l->f.dref * l->f.dref);
    l->f.rho[i] = rho;
    l->f.p[i] = p;
    return i;
}
/* Walls around 0 ... columns, 0 ... rows (in dx), as far as a support reaches; those of the top are left out
   unless it is closed. */
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

/* Height of the centre of mass. */
static inline double liquid_height(const liquid *l)
{
    double sum = 0, m = 0;
    int i;
    for (i = 0; i < l->f.n_fluid; i++) {
        sum += l->f.m[i] * l->f.y[i];
        m += l->f.m[i];
    }
    return sum / m;
}

/* rms over the liquid of p minus the value there of the linear least-squares fit to the pressures of the
   neighbours in the liquid, weighted by W. */
static inline double liquid_noise(const liquid *l)
{
    const flow *const f = &l->f;
    double sum = 0;
    int i, counted = 0;
    sph_index q;
    for (i = 0; i < f->n_fluid; i++) {
        double s = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, b = 0, bx = 0, by = 0, det, c;
        for (q = f->all.start[i]; q < f->all.start[i + 1]; q++) {
            const int j = (int)f->all.index[q];
            double x = f->x[j] - f->x[i], y = f->y[j] - f->y[i], w;
            if (j >= f->n_fluid) continue;
            if (f->box_x > 0) x -= f->box_x * floor(x / f->box_x + 0.5);
            if (f->box_y > 0) y -= f->box_y * floor(y / f->box_y + 0.5);
            w = sph_kernel_w(f->kernel, 2, sqrt(x * x + y * y), f->h);
            s += w, sx += w * x, sy += w * y, sxx += w * x * x, sxy += w * x * y, syy += w * y * y;
            b += w * f->p[j], bx += w * x * f->p[j], by += w * y * f->p[j];
        }
        det = s * (sxx * syy - sxy * sxy) - sx * (sx * syy - sxy * sy) + sy * (sx * sxy - sxx * sy);
        c = b * (sxx * syy - sxy * sxy) - sx * (bx * syy - sxy * by) + sy * (bx * sxy - sxx * by);
        if (!(det > 1e-6 * s * (sxx + syy) * (sxx + syy))) continue;
        sum += (f->p[i] - c / det) * (f->p[i] - c / det);
        counted++;
    }
    return counted ? sqrt(sum / counted) : 0;
}

/* ================================================================ methods side by side */

enum { LIQUID_FIGURES = 6 };
/* A method in a case: known[k], of an earlier trial, is what its figure k was there; 0: nothing is known. */
typedef struct liquid_trial {
    liquid_method method;
    double known[LIQUID_FIGURES];
} liquid_trial;

/* A case: what its figures are, and how one method gets them. seed: of a displacement of all particles by up
   to 2 % of their distance; 0: none. The run ends with liquid_end. */
typedef struct liquid_case {
    const char *item;
    int figures;
    const char *quantity[LIQUID_FIGURES];
    double factor[LIQUID_FIGURES]; /* by which a figure may differ from what is known; flows are chaotic */
    void (*run)(const liquid_method *m, int seed, const fluids_options *o, double *figure);
} liquid_case;

enum { LIQUID_SEEDS = 3, LIQUID_METHODS = 16 };
/* What the methods have shown: figures, and CPU time of a particle and step in microseconds. */
typedef struct liquid_results {
    double figure[LIQUID_METHODS][LIQUID_FIGURES], cost[LIQUID_METHODS];
} liquid_results;
static double liquid_cost; /* of the run that has ended last */

static inline void liquid_shake(liquid *l, int seed)
{
    pcg32 g;
    int i;
    if (seed == 0) return;
    pcg32_seed(&g, (uint64_t)seed, 1);
    for (i = 0; i < l->f.n_fluid; i++) {
        l->f.x[i] += 0.04 * (pcg32_uniform(&g) - 0.5) * l->f.dref;
        l->f.y[i] += 0.04 * (pcg32_uniform(&g) - 0.5) * l->f.dref;
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

/* A row for each figure of each method; with -full the range over seeds as well. Then the table: a line for
   each method. */
static inline void liquid_compare(report *r, const liquid_case *c, const liquid_trial *trial, int count,
                                  const fluids_options *o, liquid_results *x)
{
    int t, k, s;
    for (t = 0; t < count; t++) {
        const liquid_method *const m = &trial[t].method;
        double low[LIQUID_FIGURES], high[LIQUID_FIGURES];
        c->run(m, 0, o, x->figure[t]);
        x->cost[t] = liquid_cost;
        for (s = 1; s <= LIQUID_SEEDS && o->full; s++) {
            double seen[LIQUID_FIGURES];
            c->run(m, s, o, seen);
            for (k = 0; k < c->figures; k++) {
                low[k] = s == 1 ? seen[k] : fmin(low[k], seen[k]);
                high[k] = s == 1 ? seen[k] : fmax(high[k], seen[k]);
            }
        }
        for (k = 0; k < c->figures; k++) {
            const double known = trial[t].known[k], a = known / c->factor[k], b = known * c->factor[k];
            if (known != 0)
                report_range(report_beside(r, REPORT_REGRESSION), c->item, m->name, c->quantity[k], known,
                             x->figure[t][k], fmin(a, b), fmax(a, b));
            else report_info(r, c->item, m->name, c->quantity[k], x->figure[t][k]);
            if (o->full) {
                char text[64];
                snprintf(text, sizeof text, "%.4g to %.4g", low[k], high[k]);
                report_row(r, c->item, m->name, c->quantity[k], NULL, text, "three seeds", NULL, REPORT_INFO);
            }
        }
        report_info(r, c->item, m->name, "CPU time of a particle and step [us]", x->cost[t]);
    }
    printf("\n%-34s", c->item);
    for (k = 0; k < c->figures; k++) printf(" %18.18s", c->quantity[k]);
    printf(" %8s\n", "cost");
    for (t = 0; t < count; t++) {
        printf("%-34s", trial[t].method.name);
        for (k = 0; k < c->figures; k++) printf(" %18.4g", x->figure[t][k]);
        printf(" %8.2f\n", x->cost[t] / x->cost[0]);
    }
}

#endif
