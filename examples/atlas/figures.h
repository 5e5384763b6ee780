/* SPDX-License-Identifier: MIT
 *
 * figures.h - what the atlas measures of operators that are not linear: numbers with a name, on each kind of cloud.
 *
 * Clouds are small, have the spacing 1, and all their particles are targets. What is kept of momentum, angular
 * momentum and energy goes to the portrait, the worst of all clouds; the header's comment must say the same (see
 * kept_text below).
 */
#ifndef ATLAS_FIGURES_H
#define ATLAS_FIGURES_H

#include "measure.h"

enum { DRAWS = 4 }; /* of random states */

/* The number of this name, which a portrait gets if it has none yet. */
static inline double *figure_of(portrait *p, const char *name, int kind)
{
    int f = 0;
    while (f < p->figure_count && strcmp(p->figures[f].name, name) != 0) f++;
    if (f == FIGURES) {
        fprintf(stderr, "atlas: more than %d figures\n", (int)FIGURES);
        exit(2);
    }
    if (f == p->figure_count) {
        p->figures[p->figure_count++].name = name;
        for (int k = 0; k < SAMPLE_KINDS; k++) p->figures[f].value[k] = (double)NAN;
    }
    return &p->figures[f].value[kind];
}
static inline void figure_set(portrait *p, const sample *s, const char *name, double value) { *figure_of(p, name, s->kind) = value; }
static inline void figure_most(portrait *p, const sample *s, const char *name, double value)
{
    double *const at = figure_of(p, name, s->kind);
    if (isnan(*at) || value > *at) *at = value;
}

/* sum w a and sum w x cross a, for vectors a, as shares of the sums of sizes. */
static inline void sums_kept(const sample *s, const double *w, double *const *a, portrait *p)
{
    double sum[3] = {0.0, 0.0, 0.0}, all = 0.0, turn[3] = {0.0, 0.0, 0.0}, turn_all = 0.0;
    for (sph_index i = 0; i < s->n; i++) {
        double x[3], y[3] = {0.0, 0.0, 0.0};
        position(s, i, x);
        for (int c = 0; c < s->dim; c++) {
            y[c] = a[c][i];
            sum[c] += w[i] * y[c];
            all += w[i] * fabs(y[c]);
        }
        for (int c = 0; c < 3; c++) {
            const int d = (c + 1) % 3, e = (c + 2) % 3;
            turn[c] += w[i] * (x[d] * y[e] - x[e] * y[d]);
            turn_all += w[i] * fabs(x[d] * y[e]);
        }
    }
    for (int c = 0; c < 3; c++) {
        p->momentum = fmax(p->momentum, relative(fabs(sum[c]), all));
        p->angular = fmax(p->angular, relative(fabs(turn[c]), turn_all));
    }
}

/* ---- density with a smoothing length of its own ---- */

/* Passes over the list: steps of Newton's method from the same guess, by the header's pair functions. 0: they do not
   end at the h of the sweep. */
static inline int newton_passes(const sample *s, sph_index i, double eta, double found)
{
    const sph_list list = search_list(&s->lists);
    double h = eta * s->spacing;
    for (int pass = 1; pass <= 30; pass++) {
        sph_density_sums sums = sph_density_pair(s->k, s->dim, SPH_R(0), s->volume[i]);
        for (sph_index q = list.start[i]; q < list.start[i + 1]; q++) {
            double r2 = 0.0;
            for (int c = 0; c < s->dim; c++) {
                const double d = s->x[c][i] - s->x[c][list.index[q]];
                r2 += d * d;
            }
            const sph_density_sums add = sph_density_pair(s->k, s->dim, SPH_R(sqrt(r2) / h), s->volume[list.index[q]]);
            sums.weight += add.weight;
            sums.slope += add.slope;
        }
        const double mismatch = sph_density_mismatch(s->k, s->dim, sums, s->volume[i], SPH_R(eta));
        if (fabs(exp(mismatch) - 1.0) <= 1e-3) return fabs(h / found - 1.0) < 1e-6 ? pass : 0;
        h = fmin(h * exp(mismatch / sph_density_omega(s->dim, sums)), s->h);
    }
    return 0;
}
static inline void figures_adaptive(const op *o, sample *s, arrays *a, portrait *p)
{
    const double eta = s->h_dx / atlas_growth;
    double off = 0.0, least = HUGE_VAL, most = 0.0, left = 0.0, passes = 0.0;
    long inside = 0, counted = 0, too_short = 0;
    for (sph_index i = 0; i < s->n; i++) a->in[0][i] = 1.0;
    apply(o, s, a->in, a->out);
    for (sph_index i = 0; i < s->n; i++) {
        const double rho = a->out[0][i], h = a->out[1][i], even = eta * pow(s->volume[i], 1.0 / s->dim);
        if (s->status[i] == SPH_LIST_TOO_SHORT) too_short++;
        if (s->status[i] != SPH_OK) continue;
        least = fmin(least, h / even);
        most = fmax(most, h / even);
        left = fmax(left, fabs(eta * pow(s->volume[i] / rho, 1.0 / s->dim) / h - 1.0));
        const int n = newton_passes(s, i, eta, h);
        passes += n;
        counted += n > 0;
        if (!uncut(s, i)) continue;
        off += (rho - 1.0) * (rho - 1.0);
        inside++;
    }
    figure_set(p, s, "error of a density of 1, inside", sqrt(off / (double)inside));
    figure_set(p, s, "h / that of the right density, least", least);
    figure_set(p, s, "h / that of the right density, largest", most);
    figure_set(p, s, "mismatch of h and density that is left", left);
    figure_set(p, s, "passes over the list, mean", passes / (double)counted);
    figure_set(p, s, "share of particles whose list is too short", (double)too_short / (double)s->n);
}

/* ---- rates of a fluid ---- */

/* A state: density, pressure and velocity at a place. */
typedef void fluid_state(const double *x, int dim, double *rho, double *p, double *v);
static inline void state_moving(const double *x, int dim, double *rho, double *p, double *v)
{
    (void)x, (void)dim, (void)rho, (void)p;
    v[0] = 0.3, v[1] = -0.2, v[2] = 0.1;
}
static inline void state_contact(const double *x, int dim, double *rho, double *p, double *v)
{
    state_moving(x, dim, rho, p, v);
    *rho = x[0] > 0.0 ? 10.0 : 1.0;
}
static inline void state_jump(const double *x, int dim, double *rho, double *p, double *v)
{
    (void)dim, (void)rho, (void)v;
    *p = x[0] > 0.0 ? 1.1 : 1.0;
}
static inline void state_shear(const double *x, int dim, double *rho, double *p, double *v)
{
    (void)dim, (void)rho;
    *p = 0.0;
    v[0] = 0.1 * x[1];
}
static inline void state_squeeze(const double *x, int dim, double *rho, double *p, double *v)
{
    (void)rho;
    *p = 0.0;
    for (int c = 0; c < dim; c++) v[c] = -0.1 * x[c];
}
static inline void state_turning(const double *x, int dim, double *rho, double *p, double *v)
{
    (void)dim, (void)rho;
    *p = 0.0;
    v[0] = -0.1 * x[1], v[1] = 0.1 * x[0];
}
enum { SOUND = 10 }; /* c of all these states, in which the spacing is 1 */
static inline void fluid_fill(sample *s, arrays *a, fluid_state *state)
{
    for (sph_index i = 0; i < s->n; i++) {
        double x[3], rho = 1.0, pressure = 1.0, v[3] = {0.0, 0.0, 0.0};
        position(s, i, x);
        state(x, s->dim, &rho, &pressure, v);
        s->state[STATE_M][i] = s->volume[i] * rho;
        s->state[STATE_RHO][i] = rho;
        s->state[STATE_P][i] = pressure;
        s->state[STATE_C][i] = SOUND;
        for (int c = 0; c < INPUTS; c++) a->in[c][i] = v[c];
    }
}
/* Root mean squares over particles that nothing cuts, within a support of the plane x = 0 if `near_by`. */
typedef struct fluid_sizes {
    double acceleration, rate, loss; /* loss: -sum m v . a of all particles, / sum of their volumes */
} fluid_sizes;
static inline fluid_sizes fluid_measure(const op *o, sample *s, arrays *a, fluid_state *state, int near_by)
{
    fluid_sizes f = {0.0, 0.0, 0.0};
    double volume = 0.0;
    long count = 0;
    fluid_fill(s, a, state);
    apply(o, s, a->in, a->out);
    for (sph_index i = 0; i < s->n; i++) {
        double size = 0.0;
        volume += s->volume[i];
        for (int c = 0; c < s->dim; c++) {
            const double force = s->state[STATE_RHO][i] * a->out[c][i];
            f.loss -= s->volume[i] * a->in[c][i] * force;
            size += force * force;
        }
        if (!uncut(s, i) || (near_by && fabs(s->x[0][i]) > sample_reach(s))) continue;
        f.acceleration += size;
        f.rate += a->out[3][i] * a->out[3][i];
        count++;
    }
    f.acceleration = sqrt(f.acceleration / (double)count);
    f.rate = sqrt(f.rate / (double)count);
    f.loss /= volume;
    return f;
}
static inline void figures_rates(const op *o, sample *s, arrays *a, portrait *p)
{
    const double per = 1.0 / (0.01 * SOUND * s->h_dx); /* of a loss by gradients of velocity of 0.1: nu / (c h) */
    pcg32 g;
    pcg32_seed(&g, 271, 8);
    for (int draw = 0; draw < DRAWS; draw++) {
        double elastic = 0.0, heat = 0.0, size = 0.0;
        for (sph_index i = 0; i < s->n; i++) {
            const double rho = 0.5 + pcg32_uniform(&g);
            s->state[STATE_M][i] = s->volume[i] * rho;
            s->state[STATE_RHO][i] = rho;
            s->state[STATE_P][i] = 2.0 * pcg32_uniform(&g);
            s->state[STATE_C][i] = 1.0 + pcg32_uniform(&g);
            for (int c = 0; c < INPUTS; c++) a->in[c][i] = pcg32_uniform(&g) - 0.5;
        }
        apply(o, s, a->in, a->out);
        sums_kept(s, s->state[STATE_M], a->out, p);
        for (sph_index i = 0; i < s->n; i++) {
            const double m = s->state[STATE_M][i], rho = s->state[STATE_RHO][i], squeezed = m * s->state[STATE_P][i] / (rho * rho) * a->out[3][i];
            double work = 0.0;
            for (int c = 0; c < s->dim; c++) work += m * a->in[c][i] * a->out[c][i];
            elastic += work + squeezed;
            size += fabs(work) + fabs(squeezed);
            heat += m * a->out[4][i];
        }
        p->energy = fmax(p->energy, elastic / size);
        figure_most(p, s, "random state: rate of kinetic and elastic energy, of the sum of sizes", elastic / size);
        figure_most(p, s, "the same with the heat", (elastic + heat) / size);
    }
    fluid_sizes f = fluid_measure(o, s, a, state_moving, 0);
    figure_set(p, s, "uniform motion: force, in p / dx", f.acceleration);
    figure_set(p, s, "uniform motion: density rate, in rho c / dx", f.rate / SOUND);
    f = fluid_measure(o, s, a, state_contact, 1);
    figure_set(p, s, "contact, densities 1 and 10: force, in p / dx", f.acceleration);
    figure_set(p, s, "contact: density rate, in rho c / dx", f.rate / SOUND);
    f = fluid_measure(o, s, a, state_jump, 1);
    figure_set(p, s, "jump of pressure, at rest: density rate, in jump / (c dx)", f.rate * SOUND / 0.1);
    figure_set(p, s, "shear of c / (100 dx): viscosity that it has, in c h", fluid_measure(o, s, a, state_shear, 0).loss * per);
    figure_set(p, s, "compression of c / (100 dx) along each axis: loss, in rho c h of its square", fluid_measure(o, s, a, state_squeeze, 0).loss * per);
    figure_set(p, s, "rigid rotation: force, in rho c^2 / dx", fluid_measure(o, s, a, state_turning, 0).acceleration / (SOUND * SOUND));
}

/* ---- shifting ---- */

/* Nearest neighbours, of particles that count (null: of all). */
static inline void figures_nearest(const sample *s, arrays *a, portrait *p, const char *const *name, const unsigned char *counts)
{
    double least = HUGE_VAL, sum = 0.0;
    long count = 0;
    expect_all(sph_nearest_distance(s->dim, s->cloud, s->cloud.points, sph_scalar_out_array(a->other[0], NULL)));
    for (sph_index i = 0; i < s->n; i++) {
        if (counts && !counts[i]) continue;
        least = fmin(least, a->other[0][i]);
        sum += a->other[0][i];
        count++;
    }
    figure_set(p, s, name[0], least);
    figure_set(p, s, name[1], sum / (double)count);
}
/* How evenly the particles lie that move: nearest neighbours, and the density that all sum up. */
static inline void figures_evenness(const sample *s, arrays *a, portrait *p, const char *const *name, const unsigned char *moves)
{
    double density = 0.0, square = 0.0;
    long count = 0;
    figures_nearest(s, a, p, name, moves);
    expect_all(sph_density_summation(s->k, s->dim, s->cloud, sph_scalars_same(&atlas_one), sph_scalar_out_array(a->other[1], NULL)));
    for (sph_index i = 0; i < s->n; i++) {
        if (!moves[i]) continue;
        density += a->other[1][i];
        square += a->other[1][i] * a->other[1][i];
        count++;
    }
    density /= (double)count;
    figure_set(p, s, name[2], sqrt(fmax(0.0, square / (double)count - density * density)) / density);
}
static inline void figures_shifting(const op *o, sample *s, arrays *a, portrait *p)
{
    static const char *const name[3][3] = {{"nearest neighbour, least, in dx: before", "nearest neighbour, mean, in dx: before", "spread of the density: before"},
                                           {"least, after one step", "mean, after one step", "spread, after one step"},
                                           {"least, after ten steps", "mean, after ten steps", "spread, after ten steps"}};
    unsigned char *const moves = (unsigned char *)need_zeros((size_t)s->n, 1);
    double longest = 0.0;
    apply(o, s, a->in, a->out); /* with the volumes that they have */
    sums_kept(s, s->volume, a->out, p);
    for (sph_index i = 0; i < s->n; i++) {
        moves[i] = (unsigned char)uncut(s, i);
        s->unit_volume[i] = 1.0;
    }
    sample_zoom(s, 1.0);
    figures_evenness(s, a, p, name[0], moves);
    for (int step = 1; step <= 10; step++) { /* those that the edge cuts hold the others */
        apply(o, s, a->in, a->out);
        for (sph_index i = 0; i < s->n; i++) {
            double square = 0.0;
            if (!moves[i]) continue;
            for (int c = 0; c < s->dim; c++) {
                s->unit[c][i] += a->out[c][i];
                square += a->out[c][i] * a->out[c][i];
            }
            if (step == 1) longest = fmax(longest, sqrt(square));
        }
        sample_lists(s);
        sample_zoom(s, 1.0);
        if (step == 1) figures_evenness(s, a, p, name[1], moves);
    }
    figures_evenness(s, a, p, name[2], moves);
    figure_set(p, s, "longest displacement of the first step, in h", longest / s->h);
    free(moves);
}

/* ---- collisions ---- */

/* Random velocities, and masses between 1/2 and 2. */
static inline void collisions_fill(sample *s, arrays *a)
{
    pcg32 g;
    pcg32_seed(&g, 3141, 6);
    for (sph_index i = 0; i < s->n; i++) {
        s->state[STATE_M][i] = 0.5 + 1.5 * pcg32_uniform(&g);
        s->state[STATE_W][i] = 1.0 / s->state[STATE_M][i];
        for (int c = 0; c < INPUTS; c++) a->in[c][i] = pcg32_uniform(&g) - 0.5;
    }
}
/* Pairs within the distance that approach, per particle. */
static inline double approaching(const sample *s, double *const *v)
{
    sph_collision bounce = {SPH_R(0.75), SPH_R(0), {NULL, 0}};
    double count = 0.0;
    bounce.inverse_mass = sph_scalars_array(s->state[STATE_W]);
    expect_all(sph_collision_count(s->dim, s->cloud, bounce, vectors_of(v, s->dim), s->collisions));
    for (sph_index i = 0; i < s->n; i++) count += 0.5 * (double)s->collisions[i];
    return count / (double)s->n;
}
static inline double kinetic(const sample *s, double *const *v)
{
    double sum = 0.0;
    for (sph_index i = 0; i < s->n; i++)
        for (int c = 0; c < s->dim; c++) sum += 0.5 * s->state[STATE_M][i] * v[c][i] * v[c][i];
    return sum;
}
static inline void figures_collisions(const op *o, sample *s, arrays *a, portrait *p)
{
    static const char *const before_all[2] = {"nearest neighbour, least, in dx: before", "nearest neighbour, mean, in dx: before"};
    static const char *const name[2][2] = {{"least, after a flight without collisions", "mean, after a flight without collisions"}, {"least, after a flight with collisions", "mean, after a flight with collisions"}};
    double *start[3];
    for (int c = 0; c < 3; c++) {
        start[c] = numbers(s->n);
        memcpy(start[c], s->unit[c], (size_t)s->n * sizeof *start[c]);
    }
    collisions_fill(s, a);
    const double before = kinetic(s, a->in);
    figure_set(p, s, "pairs that approach, for a particle: before", approaching(s, a->in));
    apply(o, s, a->in, a->out);
    sums_kept(s, s->state[STATE_M], a->out, p);
    for (int c = 0; c < s->dim; c++)
        for (sph_index i = 0; i < s->n; i++) a->in[c][i] += a->out[c][i];
    figure_set(p, s, "pairs that approach, for a particle: after one call", approaching(s, a->in));
    const double change = kinetic(s, a->in) / before - 1.0;
    figure_set(p, s, "change of the kinetic energy by one call, of all", change);
    p->energy = fmax(p->energy, change);
    figures_nearest(s, a, p, before_all, NULL);
    for (int with = 0; with < 2; with++) { /* 20 steps of a twentieth of a spacing at most, along an axis */
        for (int c = 0; c < 3; c++) memcpy(s->unit[c], start[c], (size_t)s->n * sizeof *start[c]);
        for (int step = 0; step < 20; step++) {
            sample_lists(s);
            sample_zoom(s, 1.0);
            if (step == 0) collisions_fill(s, a);
            for (sph_index i = 0; i < s->n; i++) s->state[STATE_W][i] = 1.0;
            apply(o, s, a->in, a->out);
            for (int c = 0; c < s->dim; c++)
                for (sph_index i = 0; i < s->n; i++) {
                    if (with) a->in[c][i] += a->out[c][i];
                    s->unit[c][i] += 0.1 * a->in[c][i];
                }
        }
        sample_lists(s);
        sample_zoom(s, 1.0);
        figures_nearest(s, a, p, name[with], NULL);
    }
    for (int c = 0; c < 3; c++) free(start[c]);
}

/* ---- gravity: a ball of the density 1 (G = 1) within 0.45 of the width, and random masses ---- */

static inline double gravity_energy(const op *o, sample *s, arrays *a, double *const *to)
{
    double sum = 0.0;
    apply(o, s, a->in, to);
    for (sph_index i = 0; i < s->n; i++) sum += 0.5 * s->volume[i] * a->in[0][i] * to[3][i];
    return sum;
}
static inline void figures_gravity(const op *o, sample *s, arrays *a, portrait *p)
{
    const double radius = 0.45 * (s->side - 0.5), pi = acos(-1.0), edge = 4.0 / 3.0 * pi * radius, small = 1e-4;
    double force = 0.0, potential = 0.0, outside = 0.0, work = 0.0, size = 0.0, change = 0.0;
    long inside = 0, others = 0;
    pcg32 g;
    pcg32_seed(&g, 17, 29);
    for (sph_index i = 0; i < s->n; i++) a->in[0][i] = hypot(hypot(s->x[0][i], s->x[1][i]), s->x[2][i]) < radius ? 1.0 : 0.0;
    apply(o, s, a->in, a->out);
    for (sph_index i = 0; i < s->n; i++) {
        const double r = hypot(hypot(s->x[0][i], s->x[1][i]), s->x[2][i]), pull = r < radius ? 4.0 / 3.0 * pi : edge * radius * radius / (r * r * r);
        double square = 0.0;
        for (int c = 0; c < 3; c++) square += (a->out[c][i] + pull * s->x[c][i]) * (a->out[c][i] + pull * s->x[c][i]);
        if (r < radius) {
            const double off = a->out[3][i] + 2.0 * pi * (radius * radius - r * r / 3.0);
            force += square;
            potential += off * off;
            inside++;
        } else {
            outside += square;
            others++;
        }
    }
    figure_set(p, s, "ball: error of the acceleration inside, of that at its surface", sqrt(force / (double)inside) / edge);
    figure_set(p, s, "ball: error of the acceleration outside, of that at its surface", sqrt(outside / (double)others) / edge);
    figure_set(p, s, "ball: error of the potential inside, of that at its surface", sqrt(potential / (double)inside) / (edge * radius));
    for (sph_index i = 0; i < s->n; i++) {
        a->in[0][i] = pcg32_uniform(&g);
        s->state[STATE_M][i] = s->volume[i] * a->in[0][i];
        for (int c = 0; c < 3; c++) a->other[c][i] = pcg32_uniform(&g) - 0.5;
    }
    apply(o, s, a->in, a->out);
    sums_kept(s, s->state[STATE_M], a->out, p);
    for (sph_index i = 0; i < s->n; i++)
        for (int c = 0; c < 3; c++) {
            const double part = s->state[STATE_M][i] * a->out[c][i] * a->other[c][i];
            work += part;
            size += fabs(part);
        }
    for (int way = -1; way <= 1; way += 2) { /* the energy of the cloud that is moved a little both ways */
        for (int c = 0; c < 3; c++)
            for (sph_index i = 0; i < s->n; i++) s->x[c][i] += (way < 0 ? -1.0 : 2.0) * small * a->other[c][i];
        change += way * gravity_energy(o, s, a, a->out) / (2.0 * small);
    }
    p->energy = fmax(p->energy, fabs(change + work) / size);
    figure_set(p, s, "work against the change of the energy, by differences", fabs(change + work) / size);
}

/* ---- all ---- */

static inline void measure_figures(const op *o, const config *c, portrait *p)
{
    if (o->family < LINEAR || (o->family == GRAVITY && c->dim < 3)) return;
    p->energy = -HUGE_VAL;
    for (int kind = 0; kind < SAMPLE_KINDS; kind++) {
        const sample_wish wish = {kind, 0, c->dim == 2 ? 25 : 13, kind == SAMPLE_RELAXED ? 0.3 : atlas_default_jitter, 13};
        sample s = sample_make(c->k, c->dim, c->h_dx, wish);
        arrays a = arrays_of(s.n);
        sample_zoom(&s, 1.0);
        switch (o->family) {
        case ADAPTIVE: figures_adaptive(o, &s, &a, p); break;
        case RATES: figures_rates(o, &s, &a, p); break;
        case SHIFTING: figures_shifting(o, &s, &a, p); break;
        case COLLISIONS: figures_collisions(o, &s, &a, p); break;
        default: figures_gravity(o, &s, &a, p);
        }
        arrays_free(&a);
        sample_free(&s);
    }
}

/* What is kept, in the words that the comment of the function must have; empty for families without. */
static inline void kept_text(int which, const portrait *p, char text[160])
{
    static const char *const none = "Atlas: keeps nothing.";
    const int momentum = p->momentum < 1e-10, angular = p->angular < 1e-10;
    *text = '\0';
    if (which == SHIFTING) snprintf(text, 160, "%s", momentum ? "Atlas: keeps the centre of volume." : none);
    else if (which > ADAPTIVE && !momentum && !angular) snprintf(text, 160, "%s", none);
    else if (which > ADAPTIVE)
        snprintf(text, 160, "Atlas: keeps %s%s%s; energy %s.", momentum ? "momentum" : "", momentum && angular ? " and " : "", angular ? "angular momentum" : "",
                 which == GRAVITY ? (p->energy < 1e-6 ? "is kept" : "is not kept") : p->energy < 1e-10 ? "never grows" : "grows");
}

#endif
