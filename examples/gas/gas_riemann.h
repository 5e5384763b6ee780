/* SPDX-License-Identifier: MIT
 *
 * gas_riemann.h - Sod's shock tube (1978, JCP 27, 1), its exact solution, and how far a gas is from it.
 *
 * rho, P = 1, 1 for x < 0 and 1/8, 0.1 for x > 0, at rest, gamma = 1.4, to t = 0.2. The waves are then between
 * x = -0.24, the head of the rarefaction, and 0.35, the shock; the contact is at 0.19.
 */
#ifndef GAS_RIEMANN_H
#define GAS_RIEMANN_H

#include "../common/tube.h"

#define SOD_END 0.2
static const tube sod_tube = {1.4, {1, 0.125}, {1, 0.1}, {{0, 0}, {0, 0}}, {-0.3, 0.45}, 0};

/* The states on both sides of the contact */
typedef struct riemann {
    double P, v, rho[2], shock; /* shock: its speed */
} riemann;
/* velocity difference across the wave of one side, at the pressure p of the contact: Toro 2009, (4.6), (4.7) */
static inline double riemann_wave(double p, double rho, double P0)
{
    const double G = sod_tube.gamma, c = sqrt(G * P0 / rho);
    if (p > P0) return (p - P0) * sqrt(2 / ((G + 1) * rho) / (p + (G - 1) / (G + 1) * P0));
    return 2 * c / (G - 1) * (pow(p / P0, (G - 1) / (2 * G)) - 1);
}
static inline riemann riemann_solve(void)
{
    const double G = sod_tube.gamma;
    double low = 0.1, high = 1;
    riemann s;
    int i;
    for (i = 0; i < 100; i++) {
        s.P = 0.5 * (low + high);
        if (riemann_wave(s.P, 1, 1) + riemann_wave(s.P, 0.125, 0.1) > 0) high = s.P;
        else low = s.P;
    }
    s.v = riemann_wave(s.P, 0.125, 0.1);
    s.rho[0] = pow(s.P, 1 / G);
    s.rho[1] = 0.125 * (s.P / 0.1 + (G - 1) / (G + 1)) / ((G - 1) / (G + 1) * s.P / 0.1 + 1);
    s.shock = s.v * s.rho[1] / (s.rho[1] - 0.125);
    return s;
}
/* rho, v, P at x / t = at */
static inline void riemann_exact(const riemann *s, double at, double *q)
{
    const double G = sod_tube.gamma, c = sqrt(G), tail = s->v - sqrt(G * s->P / s->rho[0]);
    q[0] = at < -c ? 1 : at < s->v ? s->rho[0] : at < s->shock ? s->rho[1] : 0.125;
    q[1] = at < -c || at > s->shock ? 0 : s->v;
    q[2] = at < -c ? 1 : at < s->shock ? s->P : 0.1;
    if (at > -c && at < tail) {
        const double a = 2 / (G + 1) - (G - 1) / (G + 1) * at / c;
        q[0] = pow(a, 2 / (G - 1));
        q[1] = 2 / (G + 1) * (c + at);
        q[2] = pow(a, 2 * G / (G - 1));
    }
}

enum { SOD_RHO, SOD_V, SOD_P, SOD_QUANTITIES };
static const char *const sod_name[SOD_QUANTITIES] = {"rho", "v", "P"};
static inline void sod_state(const gas *g, sph_index i, double *q)
{
    q[SOD_RHO] = g->a[RHO][i];
    q[SOD_V] = g->a[VX][i];
    q[SOD_P] = (g->gamma - 1) * g->a[RHO][i] * g->a[U][i];
}
typedef struct sod_errors {
    double l1[SOD_QUANTITIES];         /* the integral of |error| over |x| < 0.5, by the volumes of the particles */
    double mean[2][SOD_QUANTITIES];    /* of the states left and right of the contact */
    double across;                     /* largest |v| across the tube, which is 0 */
} sod_errors;
/* Of the particles that move, at the end */
static inline sod_errors sod_compare(const gas *g, const riemann *s)
{
    static const double between[2][2] = {{0.03, 0.13}, {0.22, 0.31}};
    const double section = (g->dim > 1 ? g->box[1] : 1) * (g->dim > 2 ? g->box[2] : 1);
    double in[2] = {0, 0};
    sod_errors e;
    sph_index i;
    int k, side;
    memset(&e, 0, sizeof e);
    for (i = 0; i < g->free; i++) {
        const double x = g->a[X][i], V = g->a[M][i] / g->a[RHO][i];
        double q[SOD_QUANTITIES], exact[SOD_QUANTITIES];
        if (fabs(x) > 0.5) continue;
        sod_state(g, i, q);
        riemann_exact(s, x / SOD_END, exact);
        e.across = fmax(e.across, hypot(g->a[VY][i], g->a[VZ][i]));
        for (k = 0; k < SOD_QUANTITIES; k++) e.l1[k] += V / section * fabs(q[k] - exact[k]);
        for (side = 0; side < 2; side++)
            if (x > between[side][0] && x < between[side][1]) {
                in[side] += V;
                for (k = 0; k < SOD_QUANTITIES; k++) e.mean[side][k] += V * q[k];
            }
    }
    for (side = 0; side < 2; side++)
        for (k = 0; k < SOD_QUANTITIES; k++) e.mean[side][k] /= in[side];
    return e;
}
static inline void sod_write(const gas *g, const riemann *s, const char *figures, const char *name)
{
    FILE *const data = figure_open(figures, name);
    sph_index i;
    fprintf(data, "x,rho,v,P,alpha,exact rho,exact v,exact P\n");
    for (i = 0; i < g->free; i++) {
        double q[SOD_QUANTITIES], exact[SOD_QUANTITIES];
        sod_state(g, i, q);
        riemann_exact(s, g->a[X][i] / SOD_END, exact);
        fprintf(data, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", g->a[X][i], q[0], q[1], q[2], g->a[ALPHA][i], exact[0], exact[1], exact[2]);
    }
    figure_close(data);
}

#endif
