/* SPDX-License-Identifier: MIT
 *
 * solids_torque.c - what a free elastic block keeps: its angular momentum and its energy, with the correction L
 * in the force as in F, and without it, as it is often written.
 *
 *     cc -O2 -o solids_torque examples/solids/solids_torque.c -lm
 *     solids_torque -out DIR -figures DIR [-full]       (-h for help)
 *
 * 16 x 16 particles on the unit square, moved by up to 0.2 dx, h = 1.6 dx, lambda = mu = 1, Saint Venant &
 * Kirchhoff. Three states: an affine map, random displacements of up to 0.1 dx, and a checkerboard of 0.1 dx. Then
 * a block that is stretched by 10 % and turns, for 2000 steps (with -full 20000): what is left of its angular
 * momentum and its energy, with the hourglass control of the toolkit, which has an energy, and with that of
 * Ganzenmueller 2015 (CMAME 286, 87), which has none and feeds the motion.
 */
#include "solids.h"

enum { SIDE = 16 };

static void block(body *b, double jitter)
{
    const double dx = 1.0 / SIDE;
    pcg32 g;
    int i, j;
    sph_elastic e = {1, 1};
    pcg32_seed(&g, 5, 1);
    body_open(b, dx, 1.6 * dx, e, BODY_SAINT_VENANT_KIRCHHOFF);
    for (j = 0; j < SIDE; j++)
        for (i = 0; i < SIDE; i++) {
            const double x = i + 0.5 + jitter * (2 * pcg32_uniform(&g) - 1), y = j + 0.5 + jitter * (2 * pcg32_uniform(&g) - 1);
            body_add(b, dx * x - 0.5, dx * y - 0.5);
        }
    body_start(b);
}
/* the torque on all, over the sum of the forces times the half side */
static double torque(int state, int plain, double *force)
{
    body b;
    body_totals t;
    pcg32 g;
    int i;
    block(&b, 0.2);
    b.plain = plain;
    b.hourglass = 0;
    pcg32_seed(&g, 8, 2);
    for (i = 0; i < b.n; i++) {
        const double X = b.X[0][i], Y = b.X[1][i], sign = (i % SIDE + i / SIDE) % 2 ? 1 : -1;
        if (state == 0) {
            b.x[0][i] = 1.1 * X + 0.2 * Y;
            b.x[1][i] = 0.95 * Y - 0.1 * X;
        } else if (state == 1) {
            b.x[0][i] = X + 0.1 * b.dx * (2 * pcg32_uniform(&g) - 1);
            b.x[1][i] = Y + 0.1 * b.dx * (2 * pcg32_uniform(&g) - 1);
        } else b.x[0][i] = X + 0.1 * b.dx * sign;
    }
    body_forces(&b);
    t = body_sums(&b);
    *force = t.force;
    body_close(&b);
    return fabs(t.torque) / (0.5 * t.force);
}
/* f = alpha / 2 E V_i V_j W / |X|^2 (d_i + d_j) x_ij / |x_ij|, d_i = (F_i X_ij - x_ij) . x_ij / |x_ij|; the coefficient
   that others stands for. */
static void push_ganzenmueller(body *b)
{
    const double alpha = *(const double *)b->others;
    int i;
    sph_index p;
    for (i = 0; i < b->n; i++)
        for (p = b->cloud.list.start[i]; p < b->cloud.list.start[i + 1]; p++) {
            const sph_index j = b->cloud.list.index[p];
            const double *const F = b->gradient + 4 * i, *const G = b->gradient + 4 * j;
            const double X = b->X[0][i] - b->X[0][j], Y = b->X[1][i] - b->X[1][j], x = b->x[0][i] - b->x[0][j],
                         y = b->x[1][i] - b->x[1][j], r = hypot(x, y), R = hypot(X, Y);
            const double d = (((F[0] + G[0]) * X + (F[1] + G[1]) * Y) * x + ((F[2] + G[2]) * X + (F[3] + G[3]) * Y) * y) / r - 2 * r;
            const double push = 0.5 * alpha * b->young * b->volume[j] * sph_kernel_w(BODY_KERNEL, 2, R, b->h) / (R * R) * d / r;
            b->a[0][i] += push * x;
            b->a[1][i] += push * y;
        }
}
enum { BARE, WITH_ENERGY, GANZENMUELLER, NO_L };
static void turn(int form, int full, double *angular, double *left)
{
    static double alpha = 0.1;
    body b;
    double before, start, dt;
    int i, step;
    block(&b, 0.2);
    b.plain = form == NO_L;
    b.hourglass = form == WITH_ENERGY ? alpha : 0;
    b.push = form == GANZENMUELLER ? push_ganzenmueller : NULL;
    b.others = &alpha;
    for (i = 0; i < b.n; i++) {
        b.x[0][i] *= 1.1;
        b.v[0][i] = -0.12 * b.x[1][i];
        b.v[1][i] = 0.12 * b.x[0][i];
    }
    body_forces(&b);
    before = body_sums(&b).angular;
    start = body_energy(&b);
    dt = 0.5 * body_time_step(&b);
    for (step = 0; step < (full ? 20000 : 2000); step++) body_step(&b, dt);
    *angular = body_sums(&b).angular / before;
    *left = body_energy(&b) / start;
    body_close(&b);
}

int main(int argc, char **argv)
{
    static const char *const states[3] = {"affine map", "random, 0.1 dx", "checkerboard, 0.1 dx"};
    static const char *const forms[4] = {"no hourglass control", "hourglass control 0.1", "Ganzenmueller 0.1", "L in F only"};
    solids_options o = {".", ".", 0, 0};
    const option_spec specs[] = {SOLIDS_OPTIONS(o)};
    static report r;
    double with, without, force, kept, left;
    int state, form;
    options_parse(argc, argv, "Torque on a free block, with and without the correction in the force.", specs,
                  SOLIDS_OPTION_COUNT);
    report_open(&r, "solids_torque", o.out);
    figure_folder(o.figures, "solids_torque");
    report_section(&r, "Torque on all, over the sum of the forces and half a side");
    for (state = 0; state < 3; state++) {
        with = torque(state, 0, &force);
        without = torque(state, 1, &force);
        report_range(report_beside(&r, REPORT_THEORY), states[state], "L in F and in the force", "torque", 0, with, 0, 1e-13);
        report_range(&r, states[state], "L in F only", "torque: not 0", (double)NAN, without, 1e-5, 1);
    }
    report_section(&r, "A block that turns: what is left");
    for (form = BARE; form <= NO_L; form++) {
        turn(form, o.full && form != GANZENMUELLER, &kept, &left);
        if (form < NO_L)
            report_range(report_beside(&r, REPORT_THEORY), "turning block", forms[form], "angular momentum - 1", 0,
                         fabs(kept - 1), 0, 1e-10);
        else
            report_range(&r, "turning block", forms[form], "|angular momentum - 1|: lost", (double)NAN, fabs(kept - 1),
                         1e-4, 1e3);
        if (form < GANZENMUELLER)
            report_range(report_beside(&r, REPORT_THEORY), "turning block", forms[form], "energy", 1, left, 0.98, 1.02);
        else
            report_range(&r, "turning block", forms[form], "energy: not kept", (double)NAN, left, 1.2, 1e3);
    }
    return report_close(&r) ? 1 : 0;
}
