/* SPDX-License-Identifier: MIT
 *
 * sample.h - the clouds on which the atlas measures operators.
 *
 * A cloud is made once, in units of its spacing, and then zoomed: sample_zoom(s, dx) gives it the spacing dx.
 * Errors against the spacing so cost the same at every spacing, and the neighbours stay the same.
 *
 * The domain is a box. On its low sides (x = 0, y = 0, z = 0) particles lie on the boundary and have half a
 * volume there: a wall. On its high sides the outermost particles are half a spacing away from it and have
 * whole volumes: a free surface. Regions by what is cut off from the support R of a particle:
 *     inside   nothing within 2 R (corrections of a neighbour reach further than its kernel)
 *     wall     one low side closer than R, no other side
 *     surface  one high side closer than R, no other side
 *     corner   two or more sides closer than R
 * Of each region some particles are the targets, which come first; all are sources.
 */
#ifndef ATLAS_SAMPLE_H
#define ATLAS_SAMPLE_H

#include "../common/host.h"
#include "../common/random.h"

#include <math.h>

enum sample_kind { SAMPLE_LATTICE, SAMPLE_JITTER, SAMPLE_RELAXED, SAMPLE_POISSON, SAMPLE_RANDOM, SAMPLE_KINDS };
enum sample_region { REGION_INSIDE, REGION_WALL, REGION_SURFACE, REGION_CORNER, REGIONS, REGION_BETWEEN = REGIONS };
static inline const char *sample_kind_name(int kind)
{
    static const char *const name[SAMPLE_KINDS] = {"lattice", "jittered", "relaxed", "Poisson disc", "random"};
    return name[kind];
}
static inline const char *sample_region_name(int region)
{
    static const char *const name[REGIONS] = {"inside", "wall", "surface", "corner"};
    return name[region];
}

enum sample_state { STATE_M, STATE_RHO, STATE_P, STATE_C, STATE_W, STATES }; /* of a fluid; W: 1 / m */
enum { SAMPLE_CORRECTIONS = 16 + 6 }; /* arrays of reproducing kernels, and of IAD */
typedef struct sample {
    sph_kernel k;
    int dim, kind, side;
    double h_dx, spacing; /* h / dx, and dx */
    sph_index n, targets; /* the first ones are those that errors are measured at */
    double *unit[3], *unit_volume; /* in spacings */
    double *x[3], *volume, h;      /* zoomed */
    double *mobility;              /* of the elliptic operators */
    /* of operators with boundary integrals, for which all sides are walls: gamma, its gradient, the nearest point of
       the nearest side, and there the field and its gradient */
    double *gamma, *wall_gradient[3], *wall_point[3], *wall_value, *wall_slope[3];
    double *correction[SAMPLE_CORRECTIONS], corrected_at; /* the spacing they were made for, 0: not yet */
       /* of reproducing kernels, and C of IAD */
    unsigned char *region, *status;
    double *conditioning;
    double *scratch[3];
    double *row; /* one weight for each entry of the lists */
    /* of operators that are not linear: a fluid, which is at rest if nobody fills it otherwise; the number of collisions
       of a particle; the strength of shifting; and how far the lists reach */
    double *state[STATES], strength, list_radius;
    sph_index *collisions;
    search_grid grid;
    search_lists lists, with_self; /* without the particle itself, and with it */
    sph_cloud cloud;
} sample;

/* The particle that is the nearest to the middle of the domain. */
static inline sph_index sample_middle(const sample *s)
{
    double nearest = HUGE_VAL;
    sph_index middle = 0;
    for (sph_index i = 0; i < s->n; i++) {
        double r2 = 0.0;
        for (int a = 0; a < s->dim; a++) r2 += s->x[a][i] * s->x[a][i];
        if (r2 < nearest) nearest = r2, middle = i;
    }
    return middle;
}

/* The radius of the support, in spacings. */
static inline double sample_reach(const sample *s) { return (double)sph_kernel_support_ratio(s->k) * s->h_dx; }

static inline double *numbers(sph_index n) { return (double *)need_zeros((size_t)n, sizeof(double)); }

static inline void sample_alloc(sample *s, sph_index n)
{
    s->n = n;
    for (int a = 0; a < 3; a++) {
        s->unit[a] = numbers(n);
        s->x[a] = numbers(n);
        s->scratch[a] = numbers(n);
        s->wall_gradient[a] = numbers(n);
        s->wall_point[a] = numbers(n);
        s->wall_slope[a] = numbers(n);
    }
    s->unit_volume = numbers(n);
    s->volume = numbers(n);
    s->mobility = numbers(n);
    s->gamma = numbers(n);
    s->wall_value = numbers(n);
    s->conditioning = numbers(n);
    for (int c = 0; c < SAMPLE_CORRECTIONS; c++) s->correction[c] = numbers(n);
    for (int c = 0; c < STATES; c++) s->state[c] = numbers(n);
    s->collisions = (sph_index *)need_zeros((size_t)n, sizeof *s->collisions);
    s->region = (unsigned char *)need_zeros((size_t)n, 1);
    s->status = (unsigned char *)need_zeros((size_t)n, 1);
}

static inline void sample_free(sample *s)
{
    for (int a = 0; a < 3; a++) {
        free(s->unit[a]);
        free(s->x[a]);
        free(s->scratch[a]);
        free(s->wall_gradient[a]);
        free(s->wall_point[a]);
        free(s->wall_slope[a]);
    }
    for (int c = 0; c < SAMPLE_CORRECTIONS; c++) free(s->correction[c]);
    for (int c = 0; c < STATES; c++) free(s->state[c]);
    free(s->collisions);
    free(s->unit_volume);
    free(s->volume);
    free(s->mobility);
    free(s->gamma);
    free(s->wall_value);
    free(s->conditioning);
    free(s->region);
    free(s->status);
    free(s->row);
    search_grid_close(&s->grid);
    search_lists_close(&s->lists);
    search_lists_close(&s->with_self);
}

/* The lists of the unit positions, for any zoom. */
static inline void sample_lists(sample *s)
{
    const double radius = sample_reach(s) * 1.001;
    const sph_points points = sph_points_separate(s->n, s->unit[0], s->unit[1], s->unit[2]);
    const sph_real reach = SPH_R(radius);
    search_grid_build(&s->grid, s->dim, points, radius);
    search_lists_find(&s->lists, s->dim, &s->grid, sph_query_of(points, SPH_GATHER, sph_scalars_same(&reach), 0));
    search_lists_find(&s->with_self, s->dim, &s->grid, sph_query_of(points, SPH_GATHER, sph_scalars_same(&reach), SPH_LIST_SELF));
    free(s->row);
    s->row = numbers(s->lists.start[s->n]);
}

/* Corrections that some operators take from all particles. */
static inline sph_rk_out sample_rk_out(const sample *s)
{
    double *const *const c = s->correction;
    sph_rk_out o = {c[0], NULL, 1, {c[1], c[2], c[3], 1}, {c[4], c[5], c[6], 1}, {{c[7], c[8], c[9], 1}, {c[10], c[11], c[12], 1}, {c[13], c[14], c[15], 1}}, NULL};
    return o;
}

/* gamma and its gradient, of the box of the domain; it is not turned. */
static inline void sample_walls(sample *s)
{
    /* corners of the box that the sides join: their normals point out of it */
    static const int segment[4][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
    static const int square[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const double half_width = 0.5 * (s->side - 0.5) * s->spacing;
    double at[3][3][12]; /* corner, component, element */
    sph_wall_elements walls;
    sph_wall_gamma_out out;
    memset(at, 0, sizeof at);
    memset(&walls, 0, sizeof walls);
    memset(&out, 0, sizeof out);
    walls.n = s->dim == 2 ? 4 : 12;
    for (int e = 0; e < (int)walls.n; e++)
        for (int c = 0; c < s->dim; c++) {
            const int corner = s->dim == 2 ? segment[e][c] : square[e / 2][c == 0 ? 0 : c + e % 2];
            for (int a = 0; a < s->dim; a++) at[c][a][e] = corner >> a & 1 ? half_width : -half_width;
        }
    walls.a = sph_vectors_separate(at[0][0], at[0][1], at[0][2]);
    walls.b = sph_vectors_separate(at[1][0], at[1][1], at[1][2]);
    walls.c = sph_vectors_separate(at[2][0], at[2][1], at[2][2]);
    out.gamma = s->gamma;
    out.gradient = vectors_into(s->wall_gradient, 3);
    out.stride = 1;
    expect(sph_wall_gamma(s->k, s->dim, s->cloud, walls, out));
}
static inline void sample_corrections(sample *s)
{
    double *const *const c = s->correction + 16;
    const sph_correction_out iad = {{{c[0], c[1], c[2], 1}, {c[1], c[3], c[4], 1}, {c[2], c[4], c[5], 1}}, NULL, 1, NULL};
    expect(sph_rk_correction(s->k, s->dim, s->cloud, sample_rk_out(s)));
    expect(sph_gradient_correction_iad(s->k, s->dim, s->cloud, iad));
    s->corrected_at = s->spacing;
}
/* A is a number; B and the gradient of A are of 1 / length; the gradient of B and C of 1 / length^2. */
static inline void sample_rescale(sample *s)
{
    const double once = s->corrected_at / s->spacing;
    for (int c = 1; c < SAMPLE_CORRECTIONS; c++)
        for (sph_index i = 0; i < s->n; i++) s->correction[c][i] *= c < 7 ? once : once * once;
    for (int a = 0; a < 3; a++)
        for (sph_index i = 0; i < s->n; i++) s->wall_gradient[a][i] *= once;
    s->corrected_at = s->spacing;
}

/* From here on the spacing is dx, and positions are relative to the middle of the domain. */
static inline void sample_zoom(sample *s, double dx)
{
    const double middle = 0.5 * (s->side - 0.5), volume = pow(dx, s->dim);
    s->spacing = dx;
    s->h = s->h_dx * dx;
    for (sph_index i = 0; i < s->n; i++) {
        for (int a = 0; a < 3; a++) s->x[a][i] = a < s->dim ? dx * (s->unit[a][i] - middle) : 0.0;
        s->volume[i] = volume * s->unit_volume[i];
    }
    for (sph_index i = 0; i < s->n; i++) {
        s->state[STATE_M][i] = s->volume[i];
        s->state[STATE_W][i] = 1.0 / s->volume[i];
        s->state[STATE_RHO][i] = s->state[STATE_P][i] = 1.0;
        s->state[STATE_C][i] = 10.0;
    }
    s->strength = 0.4 * s->h * s->h;
    s->list_radius = sample_reach(s) * dx;
    s->cloud = sph_cloud_of(sph_points_separate(s->n, s->x[0], s->x[1], s->x[2]), search_list(&s->lists), sph_scalars_same(&s->h), sph_scalars_array(s->volume));
    s->cloud = sph_cloud_checked(s->dim, s->cloud);
    if (s->corrected_at > 0.0) sample_rescale(s);
    else {
        sample_corrections(s);
        sample_walls(s);
    }
    for (sph_index i = 0; i < s->n; i++) {
        const double half_width = 0.5 * (s->side - 0.5) * dx;
        int nearest = 0;
        for (int a = 0; a < 3; a++) s->wall_point[a][i] = s->x[a][i];
        for (int a = 1; a < s->dim; a++)
            if (fabs(s->x[a][i]) > fabs(s->x[nearest][i])) nearest = a;
        s->wall_point[nearest][i] = s->x[nearest][i] < 0.0 ? -half_width : half_width;
    }
    s->cloud = sph_cloud_range(s->cloud, 0, s->targets);
}

/* A particle is next to a side that cuts off a part of its support. */
static inline void sample_regions(sample *s)
{
    const double reach = sample_reach(s), top = s->side - 1.0;
    for (sph_index i = 0; i < s->n; i++) {
        int low = 0, high = 0, far_from_all = 1;
        for (int a = 0; a < s->dim; a++) {
            const double to_low = s->unit[a][i], to_high = top - s->unit[a][i];
            low += to_low < reach;
            high += to_high < reach;
            far_from_all &= to_low >= 2.0 * reach && to_high >= 2.0 * reach;
        }
        s->region[i] = (unsigned char)(low + high > 1 ? REGION_CORNER : low ? REGION_WALL : high ? REGION_SURFACE : far_from_all ? REGION_INSIDE : REGION_BETWEEN);
    }
}

/* Volumes of the cells of points that are nearest to a particle, by a fine lattice of points: those of Voronoi's cells. */
static inline void sample_voronoi(sample *s)
{
    const int fine = s->dim == 2 ? 12 : 5, cells = s->side;
    const sph_index bins = (sph_index)pow(cells, s->dim);
    sph_index *const first = (sph_index *)need_zeros((size_t)bins + 1, sizeof *first), *const next = (sph_index *)need_zeros((size_t)s->n + 1, sizeof *next);
    for (sph_index b = 0; b <= bins; b++) first[b] = -1;
    for (sph_index i = 0; i < s->n; i++) {
        sph_index b = 0;
        for (int a = s->dim; a-- > 0;) {
            int c = (int)floor(s->unit[a][i]);
            c = c < 0 ? 0 : c >= cells ? cells - 1 : c;
            b = b * cells + c;
        }
        next[i] = first[b];
        first[b] = i;
        s->unit_volume[i] = 0.0;
    }
    const int points = (int)((s->side - 0.5) * fine);
    const double cell = (s->side - 0.5) / points;
    const sph_index all = (sph_index)pow(points, s->dim);
    for (sph_index q = 0; q < all; q++) {
        double at[3] = {0.0, 0.0, 0.0}, nearest = HUGE_VAL;
        sph_index rest = q, best = 0;
        for (int a = 0; a < s->dim; a++) {
            at[a] = ((double)(rest % points) + 0.5) * cell;
            rest /= points;
        }
        for (int width = 1;; width++) { /* bins within so many of the point's own */
            int lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0};
            for (int a = 0; a < s->dim; a++) {
                const int c = (int)at[a];
                lo[a] = c - width < 0 ? 0 : c - width;
                hi[a] = c + width >= cells ? cells - 1 : c + width;
            }
            for (int z = lo[2]; z <= hi[2]; z++)
                for (int y = lo[1]; y <= hi[1]; y++)
                    for (int x = lo[0]; x <= hi[0]; x++)
                        for (sph_index i = first[x + (sph_index)cells * (y + (s->dim > 2 ? (sph_index)cells * z : 0))]; i >= 0; i = next[i]) {
                            double r2 = 0.0;
                            for (int a = 0; a < s->dim; a++) r2 += (s->unit[a][i] - at[a]) * (s->unit[a][i] - at[a]);
                            if (r2 < nearest) nearest = r2, best = i;
                        }
            if (nearest <= (double)width * width || width > cells) break;
        }
        s->unit_volume[best] += pow(cell, s->dim);
    }
    for (sph_index i = 0; i < s->n; i++) /* a particle whose cell no point lies in */
        if (s->unit_volume[i] <= 0.0) s->unit_volume[i] = 0.1 * pow(cell, s->dim);
    free(first);
    free(next);
}

/* Moves the particles that are not on a wall to where particles are few. Lattices outside of the box hold them in it. */
static inline void sample_relax(sample *s, double strength, int steps)
{
    const int frame = (int)ceil(sample_reach(s)) + 1, wide = s->side + 2 * frame;
    const sph_index all = (sph_index)pow(wide, s->dim);
    double *x[3], *to[3];
    sph_index n = s->n;
    for (int a = 0; a < 3; a++) {
        x[a] = numbers(s->n + all);
        to[a] = numbers(s->n + all);
        memcpy(x[a], s->unit[a], (size_t)s->n * sizeof(double));
    }
    for (sph_index q = 0; q < all; q++) {
        sph_index rest = q;
        int outside = 0;
        for (int a = 0; a < s->dim; a++) {
            const int c = (int)(rest % wide) - frame;
            outside |= c < 0 || c >= s->side;
            x[a][n] = c;
            rest /= wide;
        }
        n += outside;
    }
    search near_by = {0};
    const sph_real radius = SPH_R(sample_reach(s)), h = SPH_R(s->h_dx), one = SPH_R(1), push = SPH_R(strength);
    for (int step = 0; step < steps; step++) {
        const sph_points points = sph_points_separate(n, x[0], x[1], x[2]);
        sph_shift shift;
        memset(&shift, 0, sizeof shift);
        shift.strength = sph_scalars_same(&push);
        search_all(&near_by, s->dim, points, sph_scalars_same(&radius), SPH_GATHER);
        const sph_cloud cloud = sph_cloud_of(points, near_by.found.list, sph_scalars_same(&h), sph_scalars_same(&one));
        expect(sph_shift_displacement(s->k, s->dim, sph_cloud_range(cloud, 0, s->n), shift, vectors_into(to, s->dim)));
        for (int a = 0; a < s->dim; a++)
            for (sph_index i = 0; i < s->n; i++)
                if (x[a][i] > 0.0 && x[a][i] < s->side - 1.0) x[a][i] += to[a][i];
    }
    for (int a = 0; a < 3; a++) {
        memcpy(s->unit[a], x[a], (size_t)s->n * sizeof(double));
        free(x[a]);
        free(to[a]);
    }
    search_close(&near_by);
}

/* Particles by chance, half a spacing of them on the walls; those of a Poisson disc only where no other is within
   `apart`, which is less than the width of a bin. */
static inline void sample_scatter(sample *s, pcg32 *g)
{
    const double length = s->side - 0.5, apart = s->kind == SAMPLE_POISSON ? (s->dim == 2 ? 0.82 : 0.88) : 0.0;
    const int side = s->side;
    const sph_index most = (sph_index)pow(side, s->dim);
    sph_index *const first = (sph_index *)need_zeros((size_t)most, sizeof *first), *const next = (sph_index *)need_zeros((size_t)most + 1, sizeof *next);
    double *at[3];
    sph_index n = 0;
    for (int a = 0; a < 3; a++) at[a] = numbers(most + 1);
    for (sph_index b = 0; b < most; b++) first[b] = -1;
    for (long tries = 0; n < most && tries < 60L * most; tries++) {
        int cell[3] = {0, 0, 0}, free_there = 1;
        for (int a = 0; a < s->dim; a++) {
            at[a][n] = fmax(0.0, pcg32_uniform(g) * (length + 0.5) - 0.5);
            cell[a] = (int)at[a][n];
        }
        for (int q = 0; q < (s->dim > 2 ? 27 : 9) && free_there && apart > 0.0; q++) {
            const int x = cell[0] + q % 3 - 1, y = cell[1] + q / 3 % 3 - 1, z = s->dim > 2 ? cell[2] + q / 9 - 1 : 0;
            if (x < 0 || y < 0 || z < 0 || x >= side || y >= side || z >= side) continue;
            for (sph_index i = first[x + (sph_index)side * (y + (sph_index)side * z)]; i >= 0; i = next[i]) {
                double r2 = 0.0;
                for (int a = 0; a < s->dim; a++) r2 += (at[a][i] - at[a][n]) * (at[a][i] - at[a][n]);
                if (r2 < apart * apart) free_there = 0;
            }
        }
        if (!free_there) continue;
        const sph_index bin = cell[0] + (sph_index)side * (cell[1] + (sph_index)side * cell[2]);
        next[n] = first[bin];
        first[bin] = n++;
    }
    sample_alloc(s, n);
    for (int a = 0; a < 3; a++) {
        memcpy(s->unit[a], at[a], (size_t)n * sizeof(double));
        free(at[a]);
    }
    free(first);
    free(next);
}

/* Puts some particles of each region first, by chance. */
static inline void sample_choose(sample *s, int targets, pcg32 *g)
{
    sph_index *const order = (sph_index *)need_zeros((size_t)s->n, sizeof *order);
    double *const old = numbers(s->n);
    int count[REGIONS + 1] = {0};
    sph_index first = 0, last = s->n;
    for (sph_index i = 0; i < s->n; i++) order[i] = i;
    for (sph_index i = s->n - 1; i > 0; i--) { /* shuffle */
        const sph_index other = (sph_index)(pcg32_uniform(g) * (double)(i + 1)), keep = order[i];
        order[i] = order[other];
        order[other] = keep;
    }
    while (first < last) { /* those that are not wanted go to the end */
        const int region = s->region[order[first]];
        if (region < REGIONS && count[region] < targets) {
            count[region]++;
            first++;
        } else {
            const sph_index keep = order[--last];
            order[last] = order[first];
            order[first] = keep;
        }
    }
    s->targets = first;
    for (int a = 0; a < 4; a++) {
        double *const values = a < 3 ? s->unit[a] : s->unit_volume;
        memcpy(old, values, (size_t)s->n * sizeof *old);
        for (sph_index i = 0; i < s->n; i++) values[i] = old[order[i]];
    }
    free(order);
    free(old);
    sample_regions(s);
}

/* targets: of each region; 0: all particles, in their order. particles: of an edge, or 0: as many as give each region
   some particles. jitter: largest displacement along an axis, in spacings; particles on walls slide along them. */
typedef struct sample_wish {
    int kind, targets, particles;
    double jitter;
    uint64_t seed;
} sample_wish;
static inline sample sample_make(sph_kernel k, int dim, double h_dx, sample_wish wish)
{
    sample s;
    pcg32 g;
    memset(&s, 0, sizeof s);
    const int kind = wish.kind;
    const double jitter = wish.jitter;
    pcg32_seed(&g, wish.seed, (uint64_t)(17 + kind));
    s.k = k;
    s.dim = dim;
    s.h_dx = h_dx;
    s.kind = kind;
    s.side = wish.particles ? wish.particles : (int)ceil(4.0 * sample_reach(&s)) + (dim == 2 ? 6 : 3);
    if (kind == SAMPLE_POISSON || kind == SAMPLE_RANDOM) {
        sample_scatter(&s, &g);
        sample_voronoi(&s);
    } else {
        sample_alloc(&s, (sph_index)pow(s.side, dim));
        for (sph_index i = 0; i < s.n; i++) {
            sph_index rest = i;
            s.unit_volume[i] = 1.0;
            for (int a = 0; a < dim; a++) {
                const double cell = (double)(rest % s.side), way = kind == SAMPLE_LATTICE ? 0.0 : jitter * (2.0 * pcg32_uniform(&g) - 1.0);
                s.unit[a][i] = cell > 0.0 ? cell + way : 0.0;
                if (cell == 0.0) s.unit_volume[i] *= 0.5;
                rest /= s.side;
            }
        }
        if (kind == SAMPLE_RELAXED) sample_relax(&s, 0.4 * h_dx * h_dx, dim == 2 ? 40 : 20);
    }
    sample_regions(&s);
    s.targets = s.n;
    if (wish.targets) sample_choose(&s, wish.targets, &g);
    sample_lists(&s);
    return s;
}

#endif
