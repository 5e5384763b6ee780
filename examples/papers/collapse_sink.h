/* SPDX-License-Identifier: MIT
 *
 * collapse_sink.h - a sink particle: what takes the place of gas too dense to be followed. Bate, Bonnell & Price 1995, MNRAS 277, 362 (tests of creation and of accretion, what is conserved);
 * Price et al. 2018, PASA 35, e031, section 2.8 (everything within 0.8 of the radius is accreted untested).
 */
#ifndef COLLAPSE_SINK_H
#define COLLAPSE_SINK_H

#include <math.h>
#include <stddef.h>

#define SINK_UNTESTED 0.8 /* of the radius: from here on no gas comes back */

typedef struct sink {
    double m; /* 0: there is none */
    double x[3], v[3], a[3], before[3], spin[3];
    double radius, born;
    long born_step, swallowed; /* particles */
} sink;

static inline void sink_cross(const double *a, const double *b, double *out)
{
    int c;
    for (c = 0; c < 3; c++) out[c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
}

/* The particle becomes part of the sink. Kept: mass, centre of mass, linear momentum, the rate of it (the means of a, weighted by mass), and angular momentum: spin takes that of both about their centre. */
static inline void sink_absorb(sink *s, double m, const double *x, const double *v, const double *a)
{
    const double all = s->m + m, share = m / all;
    double apart[3], approach[3], spin[3];
    int c;
    for (c = 0; c < 3; c++) {
        apart[c] = x[c] - s->x[c];
        approach[c] = v[c] - s->v[c];
    }
    sink_cross(apart, approach, spin);
    for (c = 0; c < 3; c++) {
        s->spin[c] += s->m * share * spin[c];
        s->x[c] += share * apart[c];
        s->v[c] += share * approach[c];
        s->a[c] += share * (a[c] - s->a[c]);
    }
    s->m = all;
    s->swallowed++;
}

/* 1: the sink takes a particle at x with the velocity v: within its radius, bound to it, and turning too slowly for a circular orbit at the radius; or deep inside. */
static inline int sink_takes(const sink *s, double G, const double *x, const double *v)
{
    double apart[3], approach[3], turn[3], r2 = 0, v2 = 0, j2 = 0;
    int c;
    for (c = 0; c < 3; c++) {
        apart[c] = x[c] - s->x[c];
        approach[c] = v[c] - s->v[c];
        r2 += apart[c] * apart[c];
        v2 += approach[c] * approach[c];
    }
    if (!(s->m > 0) || r2 >= s->radius * s->radius) return 0;
    if (r2 < SINK_UNTESTED * SINK_UNTESTED * s->radius * s->radius) return 1;
    sink_cross(apart, approach, turn);
    for (c = 0; c < 3; c++) j2 += turn[c] * turn[c];
    return 0.5 * v2 < G * s->m / sqrt(r2) && j2 < G * s->m * s->radius;
}

/* What the tests of creation are about: the densest particle and its neighbours. Energies about their centre of mass; gravity > 0: that of their pairs, its sign left out. */
typedef struct sink_clump {
    double reach, div_v; /* of the densest: how far its neighbours are */
    double thermal, kinetic, rotation, magnetic, gravity;
} sink_clump;

/* Null: a sink may form. Else why not: the neighbours must lie within the radius and converge, heat must not hold them up, nor heat and rotation, and they must be bound (their magnetic energy counts). */
static inline const char *sink_objection(const sink_clump *c, double radius)
{
    if (c->reach >= radius) return "its neighbours reach beyond the radius";
    if (c->div_v >= 0) return "it does not converge";
    if (c->thermal > 0.5 * c->gravity) return "heat holds it up: thermal energy > half of that of gravity";
    if (c->thermal + c->rotation > c->gravity) return "heat and rotation hold it up";
    if (c->thermal + c->kinetic + c->magnetic >= c->gravity) return "it is not bound";
    return NULL;
}

#endif
