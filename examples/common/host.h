/* SPDX-License-Identifier: MIT
 *
 * host.h - what a program around the headers needs again and again: memory, answers that are looked at, a
 * search with memory that grows. Include it in the place of sph.h. What fails ends the program, with words on
 * stderr and status 2; a sweep that has no result for some particles, with status 1.
 *
 *     double *x = (double *)need(NULL, n, sizeof *x);                    n numbers
 *     expect(sph_gradient_cspm(k, 2, cloud, f, out));                    not refused
 *     expect_all(sph_mhd_rates(k, 2, cloud, state, out));                nor without a result for a particle
 *     expect_all(WITH_DIM_2_3(sph_mhd_rates, k, dim, cloud, state, out));   the same for a dim that varies
 *
 *     search near = {0};
 *     search_all(&near, 2, points, radius, SPH_GATHER);                  again and again, on the same memory
 *     cloud = sph_cloud_of(points, near.found.list, h, volume);
 *     search_close(&near);
 *
 *     search_grid grid = {0};                                            in parts: for other targets, for
 *     search_lists lists = {0};                                          several radii, for sorted rows
 *     search_grid_build(&grid, 2, sources, radius);
 *     search_lists_find(&lists, 2, &grid, sph_query_of(sources, SPH_GATHER, radii, SPH_LIST_SORTED));
 *     cloud = sph_cloud_of(sources, search_list(&lists), h, volume);
 *     search_lists_close(&lists);
 *     search_grid_close(&grid);
 *
 * The search takes seconds to compile. Programs of several files, or many programs, share one copy of it:
 * host_search.c, where all others are compiled with -DHOST_LINKED=1.
 */
#ifndef HOST_H
#define HOST_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "threads.h"

/* The argument that was refused last. */
typedef struct host_refusal {
    const char *argument;
    long particle; /* -1: of none */
    int error;
} host_refusal;
static host_refusal host_refused;
static inline void host_refuse(const char *argument, long particle, int error)
{
    threads_lock(); /* parts of a sweep may be refused side by side */
    host_refused.argument = argument;
    host_refused.particle = particle;
    host_refused.error = error;
    threads_unlock();
}
#ifndef SPH_REFUSED
#define SPH_REFUSED(argument, particle, error) host_refuse(argument, (long)(particle), (int)(error))
#endif

#include "../../sph.h"

/* ---- memory ---- */

/* realloc for count items, none of which may be 0 bytes long */
static inline void *need(void *old, size_t count, size_t size)
{
    void *const p = count <= SIZE_MAX / size ? realloc(old, (count ? count : 1) * size) : NULL;
    if (p) return p;
    fflush(stdout);
    fprintf(stderr, "out of memory (%lu x %lu bytes)\n", (unsigned long)count, (unsigned long)size);
    exit(2);
}
static inline void *need_zeros(size_t count, size_t size)
{
    return memset(need(NULL, count, size), 0, count * size);
}

/* ---- answers ---- */

/* In words, until the next call: an answer that is not 0. */
static inline const char *answer_text(sph_index answer)
{
    static char text[320];
    const host_refusal *const why = &host_refused;
    if (answer > 0) snprintf(text, sizeof text, "%ld particles without a finite result", (long)answer);
    else if (!why->argument || why->error != (int)answer) return sph_status_text((int)answer);
    else if (why->particle < 0)
        snprintf(text, sizeof text, "%s: %s", why->argument, sph_status_text((int)answer));
    else
        snprintf(text, sizeof text, "%s: %s, first at particle %ld", why->argument,
                 sph_status_text((int)answer), why->particle);
    return text;
}
static inline sph_index host_expect(sph_index answer, int of_all, const char *file, int line)
{
    if (answer == 0 || (answer > 0 && !of_all)) return answer;
    fflush(stdout);
    fprintf(stderr, "\n%s:%d: %s\n", file, line, answer_text(answer));
    exit(answer < 0 ? 2 : 1);
}
/* Not refused: how many targets are not ok. */
#define expect(answer) host_expect(answer, 0, __FILE__, __LINE__)
/* Not refused, and all targets are ok. */
#define expect_all(answer) host_expect(answer, 1, __FILE__, __LINE__)
/* expect_all in a run, at the time t: the first particle whose value is no number is named. state: arrays of
   x.n values, with their names. */
static inline void expect_finite(sph_index answer, const char *run, double t, double *const *state,
                                 const char *const *name, int arrays, sph_points x)
{
    sph_index i;
    int a;
    if (answer == 0) return;
    fflush(stdout);
    fprintf(stderr, "\n%s, t = %g: the run stops\n", run, t);
    for (a = 0; a < arrays; a++)
        for (i = 0; i < x.n; i++)
            if (!isfinite(state[a][i])) {
                fprintf(stderr, "%s of particle %ld at (%g, %g) is %g\n", name[a], (long)i, x.x[i], x.y[i],
                        state[a][i]);
                exit(1);
            }
    expect_all(answer);
}

/* ---- dimensions ---- */

/* The answer of sweep(kernel, dim, ...) with dim as a constant, for which its loops fold. Each name is a copy
   of the sweep for each dimension. */
#define WITH_DIM_2_3(sweep, kernel, dim, ...) \
    ((dim) == 2 ? sweep(kernel, 2, __VA_ARGS__) : sweep(kernel, 3, __VA_ARGS__))
#define WITH_DIM_1_2_3(sweep, kernel, dim, ...) \
    ((dim) == 1 ? sweep(kernel, 1, __VA_ARGS__) : WITH_DIM_2_3(sweep, kernel, dim, __VA_ARGS__))

/* ---- vectors: arrays that follow each other in an array of arrays ---- */

/* parts: 2 or 3 components */
static inline sph_vectors vectors_of(double *const *a, int parts)
{
    return sph_vectors_separate(a[0], a[1], parts > 2 ? a[2] : NULL);
}
static inline sph_vector_out vectors_into(double *const *a, int parts)
{
    return sph_vector_out_separate(a[0], a[1], parts > 2 ? a[2] : NULL);
}

/* ---- neighbours ---- */

/* Of all points: see sph_search. All zeros to begin with. */
typedef struct search {
    sph_neighbors found;
    void *memory;
    size_t size;
} search;
static inline void search_close(search *s) { free(s->memory); }

/* In parts: a grid, and lists that it finds. All zeros to begin with. */
typedef struct search_grid {
    sph_grid grid;
    void *work;
    size_t size;
} search_grid;
typedef struct search_lists {
    sph_index *start, *index;
    int64_t capacity;
} search_lists;

#ifndef HOST_LINKED
#define HOST_LINKED 0 /* 1: the functions of the search are those of another file, host_search.c */
#endif
#if HOST_LINKED
#define HOST_SEARCH
#else
#define HOST_SEARCH static inline
#endif
HOST_SEARCH void search_all(search *s, int dim, sph_points points, sph_scalars radius, int criterion);
HOST_SEARCH void search_grid_build(search_grid *g, int dim, sph_points sources, double radius);
HOST_SEARCH void search_lists_find(search_lists *l, int dim, const search_grid *g, sph_query query);

#if !HOST_LINKED || defined(HOST_SEARCH_HERE)
HOST_SEARCH void search_all(search *s, int dim, sph_points points, sph_scalars radius, int criterion)
{
    sph_index answer;
    while ((answer = sph_search(dim, points, radius, criterion, s->memory, s->size, &s->found)) ==
           (sph_index)SPH_ERROR_CAPACITY) {
        /* room to spare: a search that fails costs as much as one that does not */
        s->size = sph_search_size(dim, points.n, s->found.pairs + s->found.pairs / 8);
        if (s->size == 0) s->size = sph_search_size(dim, points.n, s->found.pairs);
        free(s->memory);
        s->memory = need(NULL, s->size, 1);
    }
    expect(answer);
}
HOST_SEARCH void search_grid_build(search_grid *g, int dim, sph_points sources, double radius)
{
    const sph_real support = SPH_R(radius);
    const size_t size = sph_grid_workspace(dim, sources.n);
    if (size > g->size) {
        g->work = need(g->work, size, 1);
        g->size = size;
    }
    expect(sph_grid_build(dim, sources, sph_scalars_same(&support), g->work, g->size, &g->grid));
}
HOST_SEARCH void search_lists_find(search_lists *l, int dim, const search_grid *g, sph_query query)
{
    int64_t pairs = 0;
    sph_index answer;
    l->start = (sph_index *)need(l->start, (size_t)query.targets.n + 1, sizeof *l->start);
    while ((answer = sph_grid_lists(dim, &g->grid, query, l->start, l->index, l->capacity, &pairs)) ==
           (sph_index)SPH_ERROR_CAPACITY) {
        l->capacity = pairs + pairs / 8;
        l->index = (sph_index *)need(l->index, (size_t)l->capacity, sizeof *l->index);
    }
    expect(answer);
}
#endif

static inline sph_list search_list(const search_lists *l)
{
    sph_list list;
    list.start = l->start;
    list.index = l->index;
    return list;
}
static inline void search_grid_close(search_grid *g) { free(g->work); }
static inline void search_lists_close(search_lists *l)
{
    free(l->start);
    free(l->index);
}

#endif
