/* SPDX-License-Identifier: MIT
 *
 * clustering.h - the particle code of the paper on particle clustering (Korzilius, Schilders & Anthonissen, 'Two remedies for particle clustering in SPH'), shared by the drivers of its
 * four cases: particles in two dimensions, explicit steps, collisions, what the paper's pictures show in numbers, files.
 *
 *     flow f;
 *     flow_open(&f, "box", SPH_CONVEX, 0.05, 0.1);     dref, h: everything else has a default, see the fields
 *     f.box_x = f.box_y = 1;                           periodic lengths; 0: open
 *     f.dt = 1e-4;
 *     f.state[0].rho0 = 1;  f.state[0].c = 10;         a phase
 *     for (...) flow_add(&f, x, y, 0, m);              fluid first
 *     for (...) flow_add_ghost(&f, x, y, 0, m);        then what does not move by itself
 *     if (flow_run(&f, 2.0) != FLOW_DONE) ...          to t = 2; may be called again with a later time
 *     d = flow_measure(&f, FLOW_ALL, 0, domain, NULL);
 *     flow_snapshot(&f, figures, "clustering_fig3_convex");
 *     flow_close(&f);
 *
 * A step, as the paper has it (symplectic Euler): accelerations from positions and velocities; v += dt a; collisions; x += dt v. The density is the sum (2.2), or follows (5.23).
 */
#ifndef CLUSTERING_H
#define CLUSTERING_H

#if defined(__clang__)
#pragma clang diagnostic ignored \
    "-Wpass-failed" /* kernels that are chosen at run time: those loops do not vectorise */
#endif

#include <math.h>
#include <signal.h>
#include <time.h>

#ifndef SPH_CHECK
#define SPH_CHECK \
    0 /* the lists are the search's, and each step looks for particles that are not well, and names them: flow_healthy */
#endif
#ifndef FLOW_PERIODIC
#define FLOW_PERIODIC 2 /* how many axes may be periodic, x first: those that cannot cost nothing */
#endif

#ifndef FLOW_FORM
#define FLOW_FORM(f) ((f)->form) /* a driver of one form names that here, and compiles no other */
#endif

#include "../common/host.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/random.h"
#include "../common/report.h"
#include "../common/restart.h"
#include "../common/vtk.h"
#include "collision_literal.h"

/* ================================================================ the command line */

typedef struct clustering_options {
    const char *kernel, *remedy, *out, *figures; /* kernel: null, or a run of one's own */
    double h, dref, dt, tend;                    /* h: in units of dref. 0: as the paper has it */
    int kernels, full, vtk, quiet, go_on;
} clustering_options;

/* The entries that all drivers have; their own may follow. o: a clustering_options */
/* clang-format off */
#define CLUSTERING_OPTIONS(o) \
    {"kernel", "one run of your own, with this kernel, instead of the paper's", OPTION_TEXT, &(o).kernel, 0, 0}, \
    {"remedy", "of that run: none, sequential, weighted, literal (collisions)", OPTION_TEXT, &(o).remedy, 0, 0}, \
    {"smoothing", "of that run: h / dref; 0: the paper's", OPTION_REAL, &(o).h, 0, 100}, \
    {"dref", "of that run: particle distance; 0: the paper's", OPTION_REAL, &(o).dref, 0, 1}, \
    {"dt", "time step of all runs; 0: the driver's", OPTION_REAL, &(o).dt, 0, 1}, \
    {"tend", "of that run: end; 0: the paper's", OPTION_REAL, &(o).tend, 0, 1000}, \
    {"out", "folder of the result table (and of VTK files)", OPTION_TEXT, &(o).out, 0, 0}, \
    {"figures", "folder of the figures' data", OPTION_TEXT, &(o).figures, 0, 0}, \
    {"kernels", "the table of kernels beside the paper's alone", OPTION_FLAG, &(o).kernels, 0, 0}, \
    {"full", "all variants, with the paper's time steps", OPTION_FLAG, &(o).full, 0, 0}, \
    {"vtk", "write 50 pictures of each run for ParaView", OPTION_FLAG, &(o).vtk, 0, 0}, \
    {"quiet", "no progress on the terminal", OPTION_FLAG, &(o).quiet, 0, 0}, THREADS_OPTION
/* clang-format on */
enum { CLUSTERING_OPTION_COUNT = 13 };
/* and of drivers whose long runs leave restarts */
#define CLUSTERING_CONTINUE "go on from the restarts in the folder of the results"

static inline clustering_options clustering_defaults(void)
{
    clustering_options o = {NULL, "none", ".", ".", 0, 0, 0, 0, 0, 0, 0, 0, 0};
    return o;
}
/* the option's value where it was given */
static inline double clustering_choose(double given, double usual) { return given > 0 ? given : usual; }

/* ================================================================ small things */

static const double clustering_pi = 3.14159265358979323846;
/* area of a particle of the hexagonal lattice, and distance of its rows, in units of dref^2 and dref */
static const double hexagonal = 0.86602540378443864676;

/* (1.1), (3.9), and beside them: kernels with a positive Fourier transform in two dimensions, and others made convex by the recipe of section III */
static const sph_kernel clustering_kernels[] = {SPH_WENDLAND_C2_1D,     SPH_CONVEX,
                                                SPH_WENDLAND_C2,        SPH_WENDLAND_C4,
                                                SPH_CONVEX_WENDLAND_C2, SPH_CONVEX_WENDLAND_C4,
                                                SPH_CONVEX_CUBIC_SPLINE};
enum { CLUSTERING_KERNELS = sizeof clustering_kernels / sizeof *clustering_kernels };

/* The hexagonal lattice: S = sum_j V W_ij, the particle itself included, and the factor G of the gradient of a linear field, -sum_j V r W' / 2. Both are 1 in the continuum. */
static inline void clustering_lattice(sph_kernel k, double h_over_dref, double *S, double *G)
{
    const int reach = (int)(sph_kernel_support_ratio(k) * h_over_dref / hexagonal) + 2;
    int a, b;
    *S = hexagonal * sph_kernel_w(k, 2, 0, h_over_dref);
    *G = 0;
    for (a = -2 * reach; a <= 2 * reach; a++)
        for (b = -reach; b <= reach; b++) {
            const double x = a + 0.5 * b, y = hexagonal * b, r = sqrt(x * x + y * y);
            if (a == 0 && b == 0) continue;
            *S += hexagonal * sph_kernel_w(k, 2, r, h_over_dref);
            *G -= 0.5 * hexagonal * r * r * sph_kernel_f(k, 2, r, h_over_dref);
        }
}

static volatile sig_atomic_t clustering_signal;
static inline void clustering_on_signal(int s)
{
    clustering_signal = s;
    signal(s, SIG_DFL); /* a second Ctrl-C ends the program at once */
}

static inline void clustering_written(int ok, const char *dir, const char *name)
{
    if (!ok) {
        fprintf(stderr,
                "clustering: cannot write %s/%s: %s; does the folder exist, may you write there, is the disk "
                "full?\n",
                dir, name, errno ? strerror(errno) : "unknown cause");
        exit(2);
    }
}
/* data file of a figure: write to f->to, then clustering_figure_close */
static inline void clustering_figure(part_file *f, const char *dir, const char *name)
{
    clustering_written(part_file_open(f, dir, name, "csv"), dir, name);
}
static inline void clustering_figure_close(part_file *f)
{
    clustering_written(part_file_close(f), f->path, "");
}

/* Of the pairs in rows 0 ... n - 1, those of two kinds. */
static inline void neighbours_mixed(search_lists *l, sph_index n, const unsigned char *kind)
{
    sph_index i, p, kept = 0, next = 0;
    for (i = 0; i < n; i++) {
        p = next;
        next = l->start[i + 1];
        for (; p < next; p++)
            if (kind[i] != kind[l->index[p]]) l->index[kept++] = l->index[p];
        l->start[i + 1] = kept;
    }
}

/* ================================================================ the flow */

typedef enum flow_form {
    FLOW_SUMMATION,  /* (2.2), (2.3) */
    FLOW_CONTINUITY, /* (5.23), (5.24) */
    FLOW_NUMBER      /* rho_i = m_i sum W_ij and its pressure force (Hu & Adams): takes density jumps, too */
} flow_form;

typedef enum flow_remedy {
    FLOW_NO_COLLISIONS,
    FLOW_SEQUENTIAL,
    FLOW_WEIGHTED,
    FLOW_LITERAL,
    FLOW_REMEDIES
} flow_remedy;
static const char *const flow_remedy_name[FLOW_REMEDIES] = {"none", "sequential", "weighted", "literal"};

typedef enum flow_answer { FLOW_DONE, FLOW_INTERRUPTED, FLOW_BLEW_UP } flow_answer;

enum { FLOW_PHASES = 4 };

typedef struct flow flow;
struct flow {
    /* what flow_open sets, and the driver may change before flow_run */
    const char *name; /* of the run: in messages and of VTK files */
    sph_kernel kernel;
    double dref, h, dt, t;
    double box_x, box_y; /* periodic lengths; 0: open; see FLOW_PERIODIC */
    double gravity_x, gravity_y;
    sph_tait state[FLOW_PHASES]; /* p = p0 + c^2 (rho - rho0), (2.4) with gamma = 1 */
    int form;                    /* a flow_form: the summation density */
    int rate_after_kick; /* 1: the rate of density by the new velocities, at the cost of a sweep; 0: by the old ones */
    int ghosts_evolve; /* 1: density and pressure of ghosts as those of the fluid; 0: they keep what they have */
    double alpha, eta;      /* of Monaghan's artificial viscosity: 0.1, 0.1 */
    int remedy;             /* a flow_remedy: none */
    int walls_only;         /* 1: only pairs of a fluid and a ghost particle collide */
    double distance;        /* of collisions, in units of dref: 0.85 */
    double restitution;     /* 0.01 */
    double skin;            /* of the neighbour lists, in units of dref; 0: new lists in each step */
    const char *vtk;        /* folder; null: none */
    const char *restarts;   /* folder, of runs that take more than a minute; null: none */
    int go_on;              /* 1: from the restarts that are there */
    void *kept;             /* what else the hooks carry from step to step: so many bytes; null: nothing */
    size_t kept_size;
    int quiet;              /* no progress */
    void (*step)(flow *);   /* another step than flow_step's; null: that one */
    void (*ghosts)(flow *); /* before the accelerations: sets p, v, x of ghosts */
    void (*force)(flow *);  /* after them: adds to ax, ay */
    void (*after)(flow *);  /* after each step: measures */
    void *data;             /* for these */

    /* particles: 0 ... n_fluid - 1 the fluid, then ghosts */
    int n, n_fluid, capacity;
    double *x, *y, *vx, *vy, *ax, *ay, *m, *rho, *p, *c, *rate, *volume, *inverse_mass, *old_x,
        *old_y; /* volume: with rate_after_kick only */
    unsigned char *phase, *ghost;

    /* what happened */
    int64_t steps, rebuilds, collisions, coincident;
    double collision_energy, cpu; /* change of energy by sequential collisions; seconds in flow_run */
    double
        worst_gain; /* largest gain of kinetic energy by the collisions of a step, relative to it (weighted and literal) */
    int bad; /* the first particle that was not ok, or -1 */
    const char *bad_what;

    /* private */
    search_grid grid;
    search_lists all, colliding;
    sph_index *count;
    vtk_series series;
    int stage; /* number of this call of flow_run */
};

static inline void flow_open(flow *f, const char *name, sph_kernel kernel, double dref, double h)
{
    int phase;
    memset(f, 0, sizeof *f);
    for (phase = 0; phase < FLOW_PHASES; phase++) f->state[phase].gamma = 1;
    f->name = name;
    f->kernel = kernel;
    f->dref = dref;
    f->h = h;
    f->alpha = f->eta = 0.1;
    f->distance = 0.85;
    f->restitution = 0.01;
    f->skin = 0.3;
    f->bad = -1;
}

/* Restarts of the long run of a driver; kept: see flow, or null. */
static inline void flow_restarts(flow *f, const clustering_options *o, void *kept, size_t kept_size)
{
    f->restarts = o->full || o->go_on ? o->out : NULL;
    f->go_on = o->go_on;
    f->kept = kept;
    f->kept_size = kept_size;
}

static inline void flow_close(flow *f)
{
    double *const arrays[] = {f->x, f->y, f->vx,   f->vy,     f->ax,           f->ay,    f->m,    f->rho,
                              f->p, f->c, f->rate, f->volume, f->inverse_mass, f->old_x, f->old_y};
    size_t a;
    for (a = 0; a < sizeof arrays / sizeof *arrays; a++) free(arrays[a]);
    free(f->phase);
    free(f->ghost);
    free(f->count);
    search_grid_close(&f->grid);
    search_lists_close(&f->all);
    search_lists_close(&f->colliding);
    vtk_series_end(&f->series);
}

static inline int flow_append(flow *f, double x, double y, int phase, double m, int ghost)
{
    const int i = f->n++;
    if (f->n > f->capacity) {
        double **const arrays[] = {&f->x,    &f->y,      &f->vx,           &f->vy,    &f->ax,
                                   &f->ay,   &f->m,      &f->rho,          &f->p,     &f->c,
                                   &f->rate, &f->volume, &f->inverse_mass, &f->old_x, &f->old_y};
        size_t a;
        f->capacity = 2 * f->n + 64;
        for (a = 0; a < sizeof arrays / sizeof *arrays; a++)
            *arrays[a] = (double *)need(*arrays[a], (size_t)f->capacity, sizeof(double));
        f->phase = (unsigned char *)need(f->phase, (size_t)f->capacity, 1);
        f->ghost = (unsigned char *)need(f->ghost, (size_t)f->capacity, 1);
        f->count = (sph_index *)need(f->count, (size_t)f->capacity, sizeof *f->count);
    }
    f->x[i] = x;
    f->y[i] = y;
    f->vx[i] = f->vy[i] = f->ax[i] = f->ay[i] = f->rate[i] = 0;
    f->m[i] = m;
    f->rho[i] = f->state[phase].rho0;
    f->p[i] = f->state[phase].p0;
    f->c[i] = f->state[phase].c;
    f->inverse_mass[i] = ghost ? 0 : 1 / m;
    f->phase[i] = (unsigned char)phase;
    f->ghost[i] = (unsigned char)ghost;
    return i;
}
/* A particle at rest, with the density rho0 of its phase. Returns its number. */
static inline int flow_add(flow *f, double x, double y, int phase, double m)
{
    f->n_fluid++;
    return flow_append(f, x, y, phase, m, 0);
}
/* One that pushes, but is not pushed, with the p0 of its phase: all fluid particles must be there already. */
static inline int flow_add_ghost(flow *f, double x, double y, int phase, double m)
{
    return flow_append(f, x, y, phase, m, 1);
}

static inline sph_points flow_points(const flow *f)
{
    return sph_points_periodic(sph_points_separate(f->n, f->x, f->y, NULL), FLOW_PERIODIC > 0 ? f->box_x : 0,
                               FLOW_PERIODIC > 1 ? f->box_y : 0, 0);
}
static inline sph_vectors flow_velocities(const flow *f) { return sph_vectors_separate(f->vx, f->vy, NULL); }
static inline sph_vector_out flow_accelerations(const flow *f)
{
    return sph_vector_out_separate(f->ax, f->ay, NULL);
}
/* how many have an acceleration and a rate of density: ghosts are the last */
static inline int flow_moved(const flow *f) { return f->ghosts_evolve ? f->n : f->n_fluid; }

/* ---------------------------------------------------------------- neighbours */

static inline void flow_wrap(double *x, double length, int n)
{
    int i;
    for (i = 0; i < n && length > 0; i++) x[i] -= length * floor(x[i] / length);
}

/* Lists with a skin, kept until a particle has moved by half of it: of where the particles were then. */
static inline sph_points flow_points_then(const flow *f)
{
    sph_points then = flow_points(f);
    then.x = f->old_x;
    then.y = f->old_y;
    return then;
}
static inline void flow_lists(flow *f)
{
    const sph_points then = flow_points_then(f);
    const double skin = f->skin * f->dref, reach = sph_kernel_support_ratio(f->kernel) * f->h + skin,
                 touching = f->distance * f->dref + skin;
    sph_query query;
    search_grid_build(&f->grid, 2, then, reach);
    search_lists_find(&f->all, 2, &f->grid, sph_query_of(then, SPH_GATHER, sph_scalars_same(&reach), 0));
    if (f->remedy) {
        query = sph_query_of(then, SPH_GATHER, sph_scalars_same(&touching), SPH_LIST_SORTED);
        search_lists_find(&f->colliding, 2, &f->grid, query); /* sorted: the order of collisions matters */
        if (f->walls_only) neighbours_mixed(&f->colliding, f->n, f->ghost);
    }
}
static inline void flow_neighbours(flow *f)
{
    if (f->all.start && !sph_rebuild_due(2, flow_points(f), flow_points_then(f), f->skin * f->dref)) return;
    flow_wrap(f->x, f->box_x, f->n);
    flow_wrap(f->y, f->box_y, f->n);
    memcpy(f->old_x, f->x, (size_t)f->n * sizeof *f->x);
    memcpy(f->old_y, f->y, (size_t)f->n * sizeof *f->y);
    flow_lists(f);
    f->rebuilds++;
}

/* the targets: all particles; first <= i < last; the fluid */
static inline sph_cloud flow_cloud(const flow *f)
{
    return sph_cloud_of(flow_points(f), search_list(&f->all), sph_scalars_same(&f->h), sph_scalars_none());
}
static inline sph_cloud flow_targets(const flow *f, long first, long last)
{
    return sph_cloud_range(flow_cloud(f), (sph_index)first, (sph_index)last);
}
static inline sph_cloud flow_fluid(const flow *f) { return flow_targets(f, 0, f->n_fluid); }

/* ---------------------------------------------------------------- accelerations */

/* The paper's three kernels and the Wendland C2 of two dimensions as constants, which fold; one copy for all others, which asks at each pair. SPH_SWITCH_KERNEL would make a copy for every kernel that there is, at the cost of compile time. */
/* clang-format off */
#ifndef FLOW_SWITCH_KERNEL /* a driver of fewer kernels compiles those alone */
#define FLOW_SWITCH_KERNEL(k, CALL) \
    switch (k) { \
    case SPH_WENDLAND_C2_1D: CALL(SPH_WENDLAND_C2_1D); \
    case SPH_CONVEX: CALL(SPH_CONVEX); \
    case SPH_HERMITE: CALL(SPH_HERMITE); \
    case SPH_WENDLAND_C2: CALL(SPH_WENDLAND_C2); \
    default: CALL(k); \
    }
#endif
/* clang-format on */
SPH_FN sph_index flow_density_by(sph_kernel k, const flow *f, sph_cloud targets)
{
    const sph_scalars m = sph_scalars_array(f->m);
    const sph_scalar_out rho = sph_scalar_out_array(f->rho, 0);
    return FLOW_FORM(f) == FLOW_SUMMATION ? sph_density_summation(k, 2, targets, m, rho)
                                     : sph_density_number(k, 2, targets, m, rho);
}
SPH_FN sph_index flow_rates_by(sph_kernel k, const flow *f, sph_cloud targets, sph_fluid s)
{
    sph_fluid_out out = {.acceleration = flow_accelerations(f)};
    if (FLOW_FORM(f) == FLOW_SUMMATION) return sph_fluid_rates_monaghan(k, 2, targets, s, out);
    if (FLOW_FORM(f) == FLOW_NUMBER) return sph_fluid_rates_hu_adams(k, 2, targets, s, out);
    out.rate = f->rate_after_kick ? NULL : f->rate;
    return sph_fluid_rates_colagrossi(k, 2, targets, s, out);
}
SPH_FN sph_index flow_divergence_by(sph_kernel k, const flow *f, sph_cloud targets)
{
    const double one = 1;
    sph_medium g;
    g.m = sph_scalars_array(f->volume);
    g.rho = g.omega = sph_scalars_same(&one);
    return sph_divergence_difference(k, 2, targets, g, flow_velocities(f), sph_scalar_out_array(f->rate, 0));
}

/* Parts of the sweeps, of which each thread takes some: targets first <= i < last */
static inline long flow_density_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const sph_cloud targets = flow_targets(f, first, last);
#define FLOW_DENSITY(K) return flow_density_by(K, f, targets)
    FLOW_SWITCH_KERNEL(f->kernel, FLOW_DENSITY)
#undef FLOW_DENSITY
}
static inline long flow_rates_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const sph_cloud targets = flow_targets(f, first, last);
    sph_fluid s;
    s.m = sph_scalars_array(f->m);
    s.rho = sph_scalars_array(f->rho);
    s.p = sph_scalars_array(f->p);
    s.c = sph_scalars_array(f->c);
    s.v = flow_velocities(f);
    s.viscosity = SPH_VISCOSITY_MONAGHAN;
    s.alpha = f->alpha;
    s.beta = 0;
    s.eta = f->eta;
#define FLOW_RATES(K) return flow_rates_by(K, f, targets, s)
    FLOW_SWITCH_KERNEL(f->kernel, FLOW_RATES)
#undef FLOW_RATES
}
static inline long flow_divergence_part(void *data, long first, long last)
{
    const flow *const f = (const flow *)data;
    const sph_cloud targets = flow_targets(f, first, last);
#define FLOW_DIVERGENCE(K) return flow_divergence_by(K, f, targets)
    FLOW_SWITCH_KERNEL(f->kernel, FLOW_DIVERGENCE)
#undef FLOW_DIVERGENCE
}

static inline sph_index flow_density(flow *f)
{
    return (sph_index)threads_each(f->n_fluid, flow_density_part, f);
}
static inline sph_index flow_rates(flow *f)
{
    return (sph_index)threads_each(FLOW_FORM(f) == FLOW_CONTINUITY ? flow_moved(f) : f->n_fluid, flow_rates_part,
                                   f);
}
/* div v with the volumes m / rho of all particles */
static inline sph_index flow_divergence(flow *f)
{
    int i;
    for (i = 0; i < f->n; i++) f->volume[i] = f->m[i] / f->rho[i];
    return (sph_index)threads_each(flow_moved(f), flow_divergence_part, f);
}
/* (5.23) alone, as -rho div v: half the cost of all rates */
static inline void flow_continuity(flow *f)
{
    int i;
    expect(flow_divergence(f));
    for (i = 0; i < flow_moved(f); i++) f->rate[i] *= -f->rho[i];
}

static inline void flow_pressure(flow *f)
{
    int i;
    for (i = 0; i < flow_moved(f); i++) f->p[i] = sph_pressure_tait(f->rho[i], f->state[f->phase[i]]);
}

/* ---------------------------------------------------------------- collisions */

static inline double flow_kinetic_energy(const flow *f)
{
    double sum = 0;
    int i;
    for (i = 0; i < f->n_fluid; i++) sum += 0.5 * f->m[i] * (f->vx[i] * f->vx[i] + f->vy[i] * f->vy[i]);
    return sum;
}

/* ax, ay are free at this time: they hold the changes of velocity */
static inline void flow_collide(flow *f)
{
    const sph_cloud fluid = sph_cloud_range(
        sph_cloud_of(flow_points(f), search_list(&f->colliding), sph_scalars_none(), sph_scalars_none()), 0,
        f->n_fluid);
    const sph_collision c = {f->distance * f->dref, f->restitution, sph_scalars_array(f->inverse_mass)};
    const sph_vectors v = flow_velocities(f);
    double before, after;
    int i;
    if (f->remedy == FLOW_NO_COLLISIONS) return;
    if (f->remedy == FLOW_SEQUENTIAL) {
        sph_collision_report r = {0, 0, 0};
        expect(sph_collision_sequential(2, fluid, c, sph_vector_out_separate(f->vx, f->vy, NULL), &r));
        f->collisions += r.collisions;
        f->coincident += r.coincident;
        f->collision_energy += r.energy;
        return;
    }
    if (f->remedy == FLOW_WEIGHTED) {
        expect(sph_collision_count(2, fluid, c, v, f->count));
        expect(sph_collision_change_weighted(2, fluid, c, v, f->count, flow_accelerations(f)));
    } else collision_change_literal(2, fluid, c, v, flow_accelerations(f));
    before = flow_kinetic_energy(f);
    for (i = 0; i < f->n_fluid; i++) {
        f->vx[i] += f->ax[i];
        f->vy[i] += f->ay[i];
    }
    after = flow_kinetic_energy(f);
    f->worst_gain = fmax(f->worst_gain, (after - before) / (before + 1e-300));
}

/* ---------------------------------------------------------------- steps */

/* Names the first particle that cannot go on. A step of more than h is no flow any more. */
static inline int flow_healthy(flow *f)
{
    int i;
    for (i = 0; i < f->n_fluid && f->bad < 0; i++) {
        const double square = f->vx[i] * f->vx[i] + f->vy[i] * f->vy[i];
        if (!isfinite(f->x[i]) || !isfinite(f->y[i]) || !isfinite(square))
            f->bad_what = "position or velocity is not a number";
        else if (!isfinite(f->rho[i]) || !(f->rho[i] > 0)) f->bad_what = "density is not positive";
        else if (square * f->dt * f->dt > f->h * f->h) f->bad_what = "moved by more than h in one step";
        else continue;
        f->bad = i;
    }
    return f->bad < 0;
}

static inline void flow_step(flow *f)
{
    sph_index lost = 0;
    int i;
    flow_neighbours(f);
    if (FLOW_FORM(f) != FLOW_CONTINUITY) lost += flow_density(f);
    flow_pressure(f);
    if (f->ghosts) f->ghosts(f);
    if (lost == 0) lost = flow_rates(f);
    expect(lost);
    if (lost > 0)
        f->bad = 0,
        f->bad_what = "an acceleration or a density overflowed (not necessarily of this particle)";
    if (f->force) f->force(f);
    for (i = 0; i < f->n_fluid; i++) {
        f->vx[i] += f->dt * (f->ax[i] + f->gravity_x);
        f->vy[i] += f->dt * (f->ay[i] + f->gravity_y);
    }
    if (!flow_healthy(f)) return;
    flow_collide(f);
    if (FLOW_FORM(f) == FLOW_CONTINUITY) {
        if (f->rate_after_kick) flow_continuity(f);
        for (i = 0; i < flow_moved(f); i++) f->rho[i] += f->dt * f->rate[i];
    }
    for (i = 0; i < f->n_fluid; i++) {
        f->x[i] += f->dt * f->vx[i];
        f->y[i] += f->dt * f->vy[i];
    }
    f->steps++;
}

static inline void flow_picture(flow *f)
{
    const vtk_field fields[] = {
        {"velocity", f->vx, f->vy, NULL, NULL}, {"density", f->rho, NULL, NULL, NULL},
        {"pressure", f->p, NULL, NULL, NULL},   {"mass", f->m, NULL, NULL, NULL},
        {"phase", NULL, NULL, NULL, f->phase},  {"ghost", NULL, NULL, NULL, f->ghost}};
    clustering_written(vtk_series_add(&f->series, f->t, f->n, f->x, f->y, NULL, fields, 6), f->vtk, f->name);
}

/* ---- restarts: one for each stage, which is a call of flow_run. What a driver measures between two stages it
 * measures again, on the same numbers. */

#define FLOW_MAGIC "sph.h flow 1"
/* The name tells runs apart that have the same name and other numbers. */
static inline void flow_restart_name(const flow *f, char name[160])
{
    const double fixed[] = {f->kernel,    f->dref, f->h,     f->dt,      f->box_x,          f->box_y, f->gravity_x,
                            f->gravity_y, f->form, f->alpha, f->remedy,  f->rate_after_kick, f->eta,   f->walls_only,
                            f->distance,  f->skin, f->n,     f->n_fluid, f->restitution,    f->ghosts_evolve};
    uint64_t hash = restart_hash(RESTART_EMPTY, fixed, sizeof fixed);
    char *c;
    hash = restart_hash(hash, f->state, sizeof f->state);
    snprintf(name, 160, "clustering_%.90s_%08lx_%d", f->name, (unsigned long)(hash & 0xffffffffu), f->stage);
    for (c = name; *c; c++)
        if (!strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789", *c)) *c = '_';
}
/* step: how many of the stage are done */
static inline int flow_transfer(restart *r, flow *f, int64_t *step)
{
    double *const arrays[] = {f->x, f->y, f->vx, f->vy, f->ax, f->ay, f->m, f->rho, f->p, f->c, f->rate, f->old_x, f->old_y};
    size_t a;
    if (!restart_same(r, &f->n, sizeof f->n) || !restart_same(r, &f->n_fluid, sizeof f->n_fluid) ||
        !restart_same(r, &f->kept_size, sizeof f->kept_size) || !restart_block(r, step, sizeof *step) ||
        !restart_block(r, &f->t, sizeof f->t) || !restart_block(r, &f->steps, sizeof f->steps) ||
        !restart_block(r, &f->rebuilds, sizeof f->rebuilds) ||
        !restart_block(r, &f->collisions, sizeof f->collisions) ||
        !restart_block(r, &f->coincident, sizeof f->coincident) ||
        !restart_block(r, &f->collision_energy, sizeof f->collision_energy) ||
        !restart_block(r, &f->cpu, sizeof f->cpu) || !restart_block(r, &f->worst_gain, sizeof f->worst_gain))
        return 0;
    for (a = 0; a < sizeof arrays / sizeof *arrays; a++)
        if (!restart_block(r, arrays[a], (size_t)f->n * sizeof(double))) return 0;
    return f->kept_size == 0 || restart_block(r, f->kept, f->kept_size);
}
static inline void flow_restart_failed(const flow *f, const char *name, const char *trouble, const char *advice)
{
    fprintf(stderr, "%s: %s/%s.restart: %s%s\n", f->name, f->restarts, name, trouble, advice);
    exit(2);
}
static inline void flow_save(flow *f, int64_t step)
{
    char name[160];
    restart r;
    flow_restart_name(f, name);
    if (!restart_write(&r, f->restarts, name, FLOW_MAGIC) || !restart_end(&r, flow_transfer(&r, f, &step)))
        flow_restart_failed(f, name, r.trouble, "");
}
/* How many steps of this stage are done: 0, and nothing has happened, where there is no restart of it. */
static inline int64_t flow_load(flow *f)
{
    const double spent = f->cpu;
    int64_t step = 0;
    char name[160];
    restart r;
    int found;
    flow_restart_name(f, name);
    found = restart_read(&r, f->restarts, name, FLOW_MAGIC);
    if (found > 0 && !restart_end(&r, flow_transfer(&r, f, &step))) found = -1;
    if (found < 0) flow_restart_failed(f, name, r.trouble, "; remove it, or run without -continue");
    if (!found) return 0;
    report_cpu_before += f->cpu - spent;
    flow_lists(f);
    return step;
}

/* To the time `end`. FLOW_BLEW_UP: the run is over, f->bad, f->bad_what, f->t tell. FLOW_INTERRUPTED: Ctrl-C; the files that there are are whole. */
static inline flow_answer flow_run(flow *f, double end)
{
    const double begin = f->t;
    const int64_t steps = (int64_t)ceil((end - begin) / f->dt - 1e-6), every = steps > 50 ? steps / 50 : 1;
    clock_t clock_begin = clock();
    time_t saved = time(NULL);
    flow_answer answer = FLOW_DONE;
    progress bar;
    int64_t s;
    signal(SIGINT, clustering_on_signal);
    signal(SIGTERM, clustering_on_signal);
    progress_begin(&bar, f->name, f->quiet);
    if (f->vtk && !f->series.name) {
        vtk_series_begin(&f->series, f->vtk, f->name);
        flow_picture(f);
    }
    f->stage++;
    for (s = f->restarts && f->go_on ? flow_load(f) : 0; s < steps && answer == FLOW_DONE; s++) {
        (f->step ? f->step : flow_step)(f);
        f->t = begin + (double)(s + 1) * f->dt;
        if (!flow_healthy(f)) answer = FLOW_BLEW_UP;
        else {
            if (f->after) f->after(f);
            if (clustering_signal) answer = FLOW_INTERRUPTED;
        }
        if (f->vtk && ((s + 1) % every == 0 || answer != FLOW_DONE)) flow_picture(f);
        progress_update(&bar, (double)(s + 1) / (double)steps);
        if (f->restarts && answer != FLOW_BLEW_UP &&
            (answer == FLOW_INTERRUPTED || s + 1 == steps || difftime(time(NULL), saved) >= 60)) {
            f->cpu += (double)(clock() - clock_begin) / CLOCKS_PER_SEC;
            clock_begin = clock();
            if (answer == FLOW_INTERRUPTED || f->cpu >= 60) flow_save(f, s + 1);
            saved = time(NULL);
        }
    }
    progress_end(&bar);
    f->cpu += (double)(clock() - clock_begin) / CLOCKS_PER_SEC;
    return answer;
}

/* Where a run must have ended well: the program's end if it has not, with a message and status 3 (or 130 after Ctrl-C). */
static inline void flow_require(const flow *f, flow_answer answer)
{
    if (answer == FLOW_DONE) return;
    fflush(stdout);
    if (answer == FLOW_INTERRUPTED) {
        fprintf(stderr, "%s: interrupted at t = %g; the rows of the table so far are in its .part file%s\n",
                f->name, f->t, f->restarts ? ", and -continue goes on" : "");
        exit(130);
    }
    fprintf(stderr, "%s: blew up at t = %g: particle %d at (%g, %g): %s; try a smaller -dt\n", f->name, f->t,
            f->bad, f->x[f->bad], f->y[f->bad], f->bad_what);
    exit(3);
}

/* of CPU time for each fluid particle and step, neighbour lists and what the driver measures included */
static inline double flow_microseconds(const flow *f)
{
    return f->steps ? 1e6 * f->cpu / ((double)f->steps * f->n_fluid) : 0;
}

static inline void flow_conserved(const flow *f, sph_conserved *c)
{
    expect(sph_conserved_sums(2, flow_fluid(f), sph_scalars_array(f->m), flow_velocities(f), c));
}

/* ================================================================ what the pictures show, in numbers */

typedef struct flow_domain {
    double x0, x1, y0, y1;
} flow_domain;

/* Distances are in units of dref. */
typedef struct flow_distribution {
    double mean, least;        /* distance to the nearest neighbour */
    double below_50, below_75; /* share of the particles that are nearer to theirs */
    double hexatic;            /* mean order by the six nearest, of those that have six within four dref */
    double void_share,
        hole; /* share of the area without a particle within 0.85, and the largest distance from any (at most 4) */
} flow_distribution;

enum { FLOW_PROBES = 512, FLOW_ALL = -1 };
/* Of the fluid particles of a phase, or FLOW_ALL; the other phases, and with_ghosts the ghosts, count as neighbours. The area: points of the domain where inside(f, x, y), null: everywhere; probed each dref / 10. */
static inline flow_distribution flow_measure(flow *f, int phase, int with_ghosts, flow_domain area,
                                             int (*inside)(const flow *, double, double))
{
    const double reach = 4 * f->dref, step = 0.1 * f->dref;
    const int columns = (int)ceil((area.x1 - area.x0) / step - 1e-9),
              rows = (int)ceil((area.y1 - area.y0) / step - 1e-9);
    const sph_scalars far = sph_scalars_same(&reach);
    sph_points x = flow_points(f);
    search_lists l = {0};
    double *const value = (double *)need(NULL, (size_t)f->n, sizeof *value);
    unsigned char *const status = (unsigned char *)need(NULL, (size_t)f->n, 1);
    flow_distribution d = {0};
    double px[FLOW_PROBES], py[FLOW_PROBES], distance[FLOW_PROBES];
    unsigned char state[FLOW_PROBES];
    int i, row, column, counted = 0, ordered = 0;
    int64_t probes = 0, empty = 0;
    sph_cloud fluid;

    if (!with_ghosts) x.n = f->n_fluid;
    search_grid_build(&f->grid, 2, x, reach);
    search_lists_find(&l, 2, &f->grid, sph_query_of(x, SPH_GATHER, far, 0));
    fluid = sph_cloud_range(sph_cloud_of(x, search_list(&l), sph_scalars_none(), sph_scalars_none()), 0,
                            f->n_fluid);
    expect(sph_nearest_distance(2, fluid, x, sph_scalar_out_array(value, status)));
    d.least = HUGE_VAL;
    for (i = 0; i < f->n_fluid; i++) {
        const double nearest = status[i] ? reach / f->dref : value[i] / f->dref;
        if (phase != FLOW_ALL && f->phase[i] != phase) continue;
        counted++;
        d.mean += nearest;
        d.least = fmin(d.least, nearest);
        d.below_50 += nearest < 0.5;
        d.below_75 += nearest < 0.75;
    }
    d.mean /= counted;
    d.below_50 /= counted;
    d.below_75 /= counted;
    expect(sph_hexatic_order(fluid, sph_scalar_out_array(value, status)));
    for (i = 0; i < f->n_fluid; i++)
        if (!status[i] && (phase == FLOW_ALL || f->phase[i] == phase)) {
            d.hexatic += value[i];
            ordered++;
        }
    d.hexatic = ordered ? d.hexatic / ordered : 0;

    x.n = f->n; /* a ghost fills its place */
    search_grid_build(&f->grid, 2, x, reach);
    for (row = 0; row < rows; row++)
        for (column = 0; column < columns;) { /* in pieces, whose lists are short */
            int count = 0;
            for (; column < columns && count < FLOW_PROBES; column++) {
                const double at_x = area.x0 + (column + 0.5) * step, at_y = area.y0 + (row + 0.5) * step;
                if (inside && !inside(f, at_x, at_y)) continue;
                px[count] = at_x;
                py[count++] = at_y;
            }
            if (count == 0) continue;
            {
                const sph_points probe = sph_points_separate(count, px, py, NULL);
                search_lists_find(&l, 2, &f->grid, sph_query_of(probe, SPH_GATHER, far, SPH_LIST_FOREIGN));
                expect(sph_nearest_distance(
                    2, sph_cloud_of(probe, search_list(&l), sph_scalars_none(), sph_scalars_none()), x,
                    sph_scalar_out_array(distance, state)));
            }
            for (i = 0; i < count; i++) {
                const double r = state[i] ? reach / f->dref : distance[i] / f->dref;
                empty += r > 0.85;
                d.hole = fmax(d.hole, r);
            }
            probes += count;
        }
    d.void_share = probes ? (double)empty / (double)probes : 0;
    search_lists_close(&l);
    free(value);
    free(status);
    return d;
}

/* The radial distribution function of the fluid up to `reach` (in dref): g of `bins` shells, against n_fluid / area. Where it is largest goes to *peak_at (in dref), how large to *peak. */
static inline void flow_radial(flow *f, double area, double reach, int bins, double *g, double *peak_at,
                               double *peak)
{
    const double radius = reach * f->dref;
    sph_points x = flow_points(f);
    sph_cloud fluid;
    search near = {0};
    int b;
    x.n = f->n_fluid;
    search_all(&near, 2, x, sph_scalars_same(&radius), SPH_GATHER);
    fluid = sph_cloud_of(x, near.found.list, sph_scalars_none(), sph_scalars_none());
    expect(sph_radial_distribution(2, fluid, radius, f->n_fluid / area, bins, g));
    *peak = *peak_at = 0;
    for (b = 0; b < bins; b++)
        if (g[b] > *peak) {
            *peak = g[b];
            *peak_at = (b + 0.5) * reach / bins;
        }
    search_close(&near);
}

/* dir/name.csv: a line per particle */
static inline void flow_snapshot(const flow *f, const char *dir, const char *name)
{
    part_file to;
    int i;
    clustering_figure(&to, dir, name);
    fprintf(to.to, "x,y,vx,vy,rho,p,phase,ghost\n");
    for (i = 0; i < f->n; i++) {
        const double x = f->box_x > 0 ? f->x[i] - f->box_x * floor(f->x[i] / f->box_x) : f->x[i];
        const double y = f->box_y > 0 ? f->y[i] - f->box_y * floor(f->y[i] / f->box_y) : f->y[i];
        fprintf(to.to, "%.8g,%.8g,%.8g,%.8g,%.8g,%.8g,%d,%d\n", x, y, f->vx[i], f->vy[i], f->rho[i], f->p[i],
                f->phase[i], f->ghost[i]);
    }
    clustering_figure_close(&to);
}

/* Kernel and remedy of a run of one's own: the program's end with status 2 for a name that is none. */
static inline sph_kernel clustering_kernel(const clustering_options *o)
{
    const int k = sph_kernel_from_name(o->kernel);
    int i;
    if (k >= 0) return (sph_kernel)k;
    fprintf(stderr, "option -kernel: no kernel is called '%s'; there are", o->kernel);
    for (i = 0; i < (int)SPH_KERNEL_COUNT; i++) fprintf(stderr, " %s", sph_kernel_name((sph_kernel)i));
    fprintf(stderr, "\n");
    exit(2);
}
static inline int clustering_remedy(const clustering_options *o)
{
    int i;
    for (i = 0; i < FLOW_REMEDIES; i++)
        if (strcmp(o->remedy, flow_remedy_name[i]) == 0) return i;
    fprintf(stderr, "option -remedy: '%s' is none; there are none, sequential, weighted, literal\n",
            o->remedy);
    exit(2);
}

#endif
