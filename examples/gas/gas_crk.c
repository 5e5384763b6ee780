/* SPDX-License-Identifier: MIT
 *
 * gas_crk.c - Gresho's vortex by plain SPH, by reproducing kernels (CRKSPH) and by the integral approach (IAD).
 *
 *     cc -O2 -o gas_crk examples/gas/gas_crk.c -lm
 *     gas_crk -out DIR -figures DIR [-full]       (-h for help)
 *
 * A vortex in the unit square that repeats, in which pressure balances rotation (Gresho & Chan 1990, IJNMF 11,
 * 621): v = 5 r, 2 - 5 r, 0, rho = 1, gamma = 5/3, p = 5 in the middle. 40 x 40 particles from a lattice, h = 1.4 dx,
 * cubic spline, artificial viscosity alpha v_sig with alpha = 0.1, to t = 1. Plain SPH is sph_gas_rates: P /
 * rho^2, symmetric. The error is the mean of |v - exact| along the circles.
 */
#include "../common/figure.h"
#include "../common/options.h"
#include "gas.h"

enum { PLAIN, CRK, IAD, FORMS };

typedef struct cloud {
    int n, form;
    double h, *x[2], *v[2], *a[2], *u, *rate, *m, *rho, *p, *c, *volume, *one, *alpha;
    double *scale, *slope[2], *scale_gradient[2], *slope_gradient, *inverse;
    search near;
    sph_cloud of;
} cloud;
static double *room(int n) { return (double *)need_zeros((size_t)n, sizeof(double)); }

static void rates(cloud *g)
{
    const double support = sph_kernel_support(GAS_KERNEL, g->h), gamma = 5.0 / 3;
    const sph_points points = sph_points_periodic(sph_points_separate(g->n, g->x[0], g->x[1], NULL), 1, 1, 0);
    const sph_scalars h = sph_scalars_same(&g->h);
    const sph_vectors v = vectors_of(g->v, 2);
    int i;
    search_all(&g->near, 2, points, sph_scalars_same(&support), SPH_GATHER);
    g->of = sph_cloud_checked(2, sph_cloud_of(points, g->near.found.list, h, sph_scalars_none()));
    expect_all(sph_density_summation(GAS_KERNEL, 2, g->of, sph_scalars_array(g->m), sph_scalar_out_array(g->rho, NULL)));
    for (i = 0; i < g->n; i++) {
        g->p[i] = (gamma - 1) * g->rho[i] * g->u[i];
        g->c[i] = sqrt(gamma * g->p[i] / g->rho[i]);
        g->volume[i] = g->m[i] / g->rho[i];
    }
    g->of.volume = sph_scalars_array(g->volume);
    if (g->form == PLAIN) {
        const sph_gas s = {.medium = {sph_scalars_array(g->m), sph_scalars_array(g->rho), sph_scalars_array(g->one)},
                           .p = sph_scalars_array(g->p), .cs = sph_scalars_array(g->c),
                           .alpha = sph_scalars_array(g->alpha), .v = v, .beta = 2};
        const sph_gas_out out = {.acceleration = vectors_into(g->a, 2), .rate_u = g->rate};
        expect_all(sph_gas_rates(GAS_KERNEL, 2, g->of, s, out));
    } else {
        const sph_fluid f = {.m = sph_scalars_array(g->m), .rho = sph_scalars_array(g->rho), .p = sph_scalars_array(g->p),
                             .c = sph_scalars_array(g->c), .v = v, .viscosity = SPH_VISCOSITY_SIGNAL, .alpha = 0.1, .beta = 2};
        const sph_corrected_out out = {.acceleration = vectors_into(g->a, 2), .rate_u = g->rate};
        if (g->form == CRK) {
            const sph_rk_out to = {.scale = g->scale, .slope = vectors_into(g->slope, 2),
                                   .scale_gradient = vectors_into(g->scale_gradient, 2),
                                   .slope_gradient = sph_matrix_out_packed(2, g->slope_gradient)};
            const sph_rk rk = {sph_scalars_array(g->scale), vectors_of(g->slope, 2), vectors_of(g->scale_gradient, 2),
                               sph_matrices_packed(2, g->slope_gradient)};
            expect_all(sph_rk_correction(GAS_KERNEL, 2, g->of, to));
            expect_all(sph_gas_rates_crk(GAS_KERNEL, 2, g->of, f, rk, out));
        } else {
            const sph_correction_out to = {.inverse = sph_matrix_out_packed(2, g->inverse)};
            expect_all(sph_gradient_correction_iad(GAS_KERNEL, 2, g->of, to));
            expect_all(sph_gas_rates_iad(GAS_KERNEL, 2, g->of, f, sph_matrices_packed(2, g->inverse), out));
        }
    }
}
typedef struct vortex_result {
    double error, energy, momentum;
} vortex_result;
static vortex_result vortex(int form, int side, double end)
{
    cloud g;
    vortex_result r = {0, 0, 0};
    double t = 0, before = 0, after = 0, push[2] = {0, 0}, dt;
    const double dx = 1.0 / side;
    double *kept[5];
    int i, k, stage;
    memset(&g, 0, sizeof g);
    g.n = side * side;
    g.form = form;
    g.h = 1.4 * dx;
    for (k = 0; k < 2; k++) {
        g.x[k] = room(g.n), g.v[k] = room(g.n), g.a[k] = room(g.n), g.slope[k] = room(g.n), g.scale_gradient[k] = room(g.n);
    }
    g.u = room(g.n), g.rate = room(g.n), g.m = room(g.n), g.rho = room(g.n), g.p = room(g.n), g.c = room(g.n);
    g.volume = room(g.n), g.one = room(g.n), g.alpha = room(g.n), g.scale = room(g.n);
    g.slope_gradient = room(4 * g.n), g.inverse = room(4 * g.n);
    for (k = 0; k < 5; k++) kept[k] = room(g.n);
    for (i = 0; i < g.n; i++) {
        const double x = (i % side + 0.5) * dx - 0.5, y = (i / side + 0.5) * dx - 0.5, q = hypot(x, y);
        g.x[0][i] = x + 0.5;
        g.x[1][i] = y + 0.5;
        g.v[0][i] = -gresho_speed(q) * y / q;
        g.v[1][i] = gresho_speed(q) * x / q;
        g.u[i] = 1.5 * gresho_pressure(q);
        g.m[i] = dx * dx;
        g.one[i] = 1;
        g.alpha[i] = 0.1;
        before += g.m[i] * (g.u[i] + 0.5 * gresho_speed(q) * gresho_speed(q));
    }
    dt = end / ceil(end / (0.2 * g.h / 4.5));
    while (t < end - 0.5 * dt) { /* midpoint rule */
        double *const state[5] = {g.x[0], g.x[1], g.v[0], g.v[1], g.u};
        const double *const rate[5] = {g.v[0], g.v[1], g.a[0], g.a[1], g.rate};
        for (k = 0; k < 5; k++) memcpy(kept[k], state[k], (size_t)g.n * sizeof(double));
        for (stage = 0; stage < 2; stage++) {
            const double step = stage ? dt : 0.5 * dt;
            rates(&g);
            for (k = 0; k < 5; k++)
                for (i = 0; i < g.n; i++) state[k][i] = kept[k][i] + step * rate[k][i];
        }
        t += dt;
    }
    for (i = 0; i < g.n; i++) {
        const double x = g.x[0][i] - floor(g.x[0][i]) - 0.5, y = g.x[1][i] - floor(g.x[1][i]) - 0.5, q = hypot(x, y);
        r.error += fabs((g.v[1][i] * x - g.v[0][i] * y) / q - gresho_speed(q)) / g.n;
        after += g.m[i] * (g.u[i] + 0.5 * (g.v[0][i] * g.v[0][i] + g.v[1][i] * g.v[1][i]));
        push[0] += g.m[i] * g.v[0][i];
        push[1] += g.m[i] * g.v[1][i];
    }
    r.energy = after / before;
    r.momentum = hypot(push[0], push[1]);
    for (k = 0; k < 2; k++) free(g.x[k]), free(g.v[k]), free(g.a[k]), free(g.slope[k]), free(g.scale_gradient[k]);
    for (k = 0; k < 5; k++) free(kept[k]);
    free(g.u), free(g.rate), free(g.m), free(g.rho), free(g.p), free(g.c), free(g.volume), free(g.one);
    free(g.alpha), free(g.scale), free(g.slope_gradient), free(g.inverse);
    search_close(&g.near);
    return r;
}

int main(int argc, char **argv)
{
    static const char *const forms[FORMS] = {"plain", "CRK", "IAD"};
    const char *out = ".", *figures = ".";
    double error[FORMS];
    int full = 0, form;
    const option_spec specs[] = {{"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
                                 {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
                                 {"full", "80 x 80 particles", OPTION_FLAG, &full, 0, 0}};
    static report r;
    options_parse(argc, argv, "Gresho's vortex by plain SPH, CRKSPH and IAD.", specs, 3);
    report_open(&r, "gas_crk", out);
    figure_folder(figures, "gas_crk");
    report_section(&r, "Gresho's vortex, t = 1");
    for (form = 0; form < FORMS; form++) {
        const vortex_result v = vortex(form, full ? 80 : 40, 1);
        error[form] = v.error;
        report_info(&r, "Gresho", forms[form], "mean error of v", v.error);
        report_range(report_beside(&r, REPORT_THEORY), "Gresho", forms[form], "energy / that of the start", 1, v.energy, 0.999, 1.001);
        report_range(report_beside(&r, REPORT_THEORY), "Gresho", forms[form], "momentum", 0, v.momentum, 0, 1e-12);
    }
    report_range(&r, "Gresho", "CRK / plain", "ratio of errors", (double)NAN, error[CRK] / error[PLAIN], 0.4, 0.8);
    report_range(&r, "Gresho", "IAD / plain", "ratio of errors", (double)NAN, error[IAD] / error[PLAIN], 0.3, 0.6);
    return report_close(&r) ? 1 : 0;
}
