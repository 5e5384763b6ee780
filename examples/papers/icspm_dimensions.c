/* SPDX-License-Identifier: MIT
 *
 * icspm_dimensions.c - beyond the ICSPM paper: its method in two and three dimensions, beside CSPM and weighted least squares.
 *
 *     cc -O2 -o icspm_dimensions examples/papers/icspm_dimensions.c -lm
 *     icspm_dimensions -out DIR -figures DIR        (-h for help)
 *
 * Particles on the unit square or cube with particles on its boundary, uniform or moved by up to 0.25 dx inside, h = 2 dx. Errors are maxima over all particles,
 * corners included. Nothing here is published: the criteria are the orders that the Taylor series gives (the paper derives them in 1D).
 */
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/random.h"
#include "../common/report.h"
#include "../common/statistics.h"
#include "icspm.h"

enum { CSPM_ND, ICSPM_ND, ICSPM_FALLBACK_ND, WLS_ND, METHODS_ND };
static const char *const method_name[METHODS_ND] = {"CSPM", "ICSPM", "ICSPM or WLS", "WLS"};

/* |conditioning| is 1 inside and, on uniform clouds, above 0.067 (2D) and 0.033 (3D) at walls, edges and corners. In disorder it is below 0.02 for a few particles at walls,
   where the matrix kappa is nearly singular; there the fallback answers. */
static const double conditioning_min = 0.02;

/* f = sin(2.3 x + 1.7 y + 1.1 z + .2) + .4 x^3 + .5 e^y + .3 x z^2, in 2D with z = 0 */
static double field(sph_vec p) { return sin(2.3 * p.x + 1.7 * p.y + 1.1 * p.z + 0.2) + 0.4 * p.x * p.x * p.x + 0.5 * exp(p.y) + 0.3 * p.x * p.z * p.z; }
static sph_jet field_jet(sph_vec p)
{
    const double phase = 2.3 * p.x + 1.7 * p.y + 1.1 * p.z + 0.2, s = sin(phase), c = cos(phase);
    sph_jet j;
    j.gradient.x = 2.3 * c + 1.2 * p.x * p.x + 0.3 * p.z * p.z;
    j.gradient.y = 1.7 * c + 0.5 * exp(p.y);
    j.gradient.z = 1.1 * c + 0.6 * p.x * p.z;
    j.hessian.xx = -2.3 * 2.3 * s + 2.4 * p.x;
    j.hessian.xy = -2.3 * 1.7 * s;
    j.hessian.yy = -1.7 * 1.7 * s + 0.5 * exp(p.y);
    j.hessian.xz = -2.3 * 1.1 * s + 0.6 * p.z;
    j.hessian.yz = -1.7 * 1.1 * s;
    j.hessian.zz = -1.1 * 1.1 * s + 0.6 * p.x;
    return j;
}

typedef struct errors {
    double gradient, hessian, laplacian, conditioning; /* maxima; the smallest |conditioning| */
    int not_ok;
} errors;

/* side^dim particles; jitter in units of dx */
static errors measure(int method, int dim, int side, double jitter, uint64_t seed)
{
    const int nz = dim > 2 ? side : 1, count = side * side * nz;
    const size_t n = (size_t)count;
    const double dx = 1.0 / (side - 1), h = 2 * dx, radius = h * sph_kernel_support_ratio(ICSPM_KERNEL);
    double *const memory = (double *)need(NULL, 16 * n, sizeof *memory);
    double *const x = memory, *const y = x + n, *const z = y + n;
    double *const V = z + n, *const f = V + n, *const d = f + n;
    unsigned char *const status = (unsigned char *)need(NULL, n, 1);
    const int fallback = method == ICSPM_FALLBACK_ND;
    sph_derivatives_options o = {0};
    sph_derivatives_out out = {0};
    sph_scalars fs;
    sph_points points;
    sph_cloud cloud;
    search near = {0};
    sph_index bad;
    errors e = {0, 0, 0, HUGE_VAL, 0};
    pcg32 g;
    int i, c;
    pcg32_seed(&g, seed, 3);
    for (i = 0; i < count; i++) {
        const int at[3] = {i % side, i / side % side, i / side / side};
        double p[3];
        V[i] = 1;
        for (c = 0; c < dim; c++) {
            const int inside = at[c] > 0 && at[c] < side - 1;
            p[c] = (at[c] + (inside ? jitter * (2 * pcg32_uniform(&g) - 1) : 0)) * dx;
            V[i] *= inside ? dx : 0.5 * dx;
        }
        x[i] = p[0];
        y[i] = p[1];
        z[i] = dim > 2 ? p[2] : 0;
    }
    points = sph_points_separate(count, x, y, z);
    search_all(&near, dim, points, sph_scalars_same(&radius), SPH_GATHER);
    cloud = sph_cloud_of(points, near.found.list, sph_scalars_same(&h), sph_scalars_array(V));
    for (i = 0; i < count; i++) {
        const sph_vec p = {x[i], y[i], z[i]};
        f[i] = field(p);
    }
    out.gx = d;
    out.gy = d + n;
    out.gz = d + 2 * n;
    out.hxx = d + 3 * n;
    out.hxy = d + 4 * n;
    out.hyy = d + 5 * n;
    out.hxz = d + 6 * n;
    out.hyz = d + 7 * n;
    out.hzz = d + 8 * n;
    out.laplacian = d + 9 * n;
    out.conditioning = d + 10 * n;
    out.status = status;
    fs = sph_scalars_array(f);
    if (method == CSPM_ND) bad = WITH_DIM_2_3(sph_derivatives_cspm, ICSPM_KERNEL, dim, cloud, fs, o, out);
    else if (method == WLS_ND) bad = WITH_DIM_2_3(sph_derivatives_wls, ICSPM_KERNEL, dim, cloud, fs, o, out);
    else {
        o.conditioning_min = fallback ? conditioning_min : 0;
        o.fallback_wls = fallback;
        bad = WITH_DIM_2_3(sph_derivatives_icspm, ICSPM_KERNEL, dim, cloud, fs, o, out);
    }
    e.not_ok = (int)expect(bad);
    for (i = 0; i < count; i++) {
        const sph_vec p = {x[i], y[i], z[i]};
        const sph_jet exact = field_jet(p);
        const double gradient[3] = {exact.gradient.x, exact.gradient.y, exact.gradient.z};
        const double hessian[6] = {exact.hessian.xx, exact.hessian.xy, exact.hessian.yy,
                                   exact.hessian.xz, exact.hessian.yz, exact.hessian.zz};
        const double *const own = d + i;
        const double laplacian = exact.hessian.xx + exact.hessian.yy + (dim > 2 ? exact.hessian.zz : 0);
        for (c = 0; c < dim; c++) e.gradient = fmax(e.gradient, fabs(own[c * count] - gradient[c]));
        for (c = 0; c < (dim > 2 ? 6 : 3); c++)
            e.hessian = fmax(e.hessian, fabs(own[(3 + c) * count] - hessian[c]));
        e.laplacian = fmax(e.laplacian, fabs(out.laplacian[i] - laplacian));
        e.conditioning = fmin(e.conditioning, fabs(out.conditioning[i]));
    }
    free(memory);
    free(status);
    search_close(&near);
    return e;
}

/* ranges for the order of gradient and Hessian */
static const double order_range[METHODS_ND][2][2] = {
    {{0.8, 1.3}, {-0.3, 0.3}}, {{1.7, 2.3}, {0.8, 1.25}}, {{1.7, 2.3}, {0.8, 1.25}}, {{1.7, 2.3}, {0.8, 1.25}}};

static void convergence(report *r, FILE *csv, progress *p, int dim, double jitter, const int *sides, int levels)
{
    char title[96];
    int method, k;
    snprintf(title, sizeof title, "%dD, %s: maximum errors over all particles, boundaries and corners included", dim,
             jitter > 0 ? "jittered by 0.25 dx" : "uniform");
    report_section(r, title);
    for (method = 0; method < METHODS_ND; method++) {
        double size[8], gradient[8], hessian[8]; /* logarithms */
        char item[32], setting[64];
        for (k = 0; k < levels; k++) {
            const errors e = measure(method, dim, sides[k], jitter, 2017);
            snprintf(item, sizeof item, "%dD %s", dim, jitter > 0 ? "jittered" : "uniform");
            snprintf(setting, sizeof setting, "%s, %d per side", method_name[method], sides[k]);
            report_info(r, item, setting, "gradient", e.gradient);
            report_info(r, item, setting, "Hessian", e.hessian);
            report_info(r, item, setting, "Laplacian", e.laplacian);
            report_info(r, item, setting, "smallest |conditioning|", e.conditioning);
            if (method == ICSPM_FALLBACK_ND) report_info(r, item, setting, "particles that fell back", e.not_ok);
            else report_range(r, item, setting, "particles not ok", (double)NAN, e.not_ok, 0, 0);
            fprintf(csv, "%d,%g,%s,%d,%.9g,%.9g,%.9g\n", dim, jitter, method_name[method], sides[k], e.gradient, e.hessian, e.laplacian);
            size[k] = log(sides[k] - 1.0);
            gradient[k] = -log(e.gradient);
            hessian[k] = -log(e.hessian);
            progress_update(p, (method + (k + 1.0) / levels) / METHODS_ND);
        }
        snprintf(setting, sizeof setting, "%s, least squares over all", method_name[method]);
        if (method == ICSPM_ND && jitter > 0) { /* without the fallback the worst particle may be anything in disorder */
            report_info(r, item, setting, "order of the gradient", statistics_slope(size, gradient, levels));
            report_info(r, item, setting, "order of the Hessian", statistics_slope(size, hessian, levels));
        } else {
            report_range(r, item, setting, "order of the gradient", (double)NAN, statistics_slope(size, gradient, levels), order_range[method][0][0],
                         order_range[method][0][1]);
            report_range(r, item, setting, "order of the Hessian", (double)NAN, statistics_slope(size, hessian, levels), order_range[method][1][0],
                         order_range[method][1][1]);
        }
    }
}

int main(int argc, char **argv)
{
    static const int sides2[] = {11, 21, 41, 81, 161}, sides3[] = {9, 17, 25, 33};
    const char *out = ".", *dir = ".";
    int full = 0, quiet = 0, dim, jittered;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &dir, 0, 0},
        {"full", "one finer cloud each", OPTION_FLAG, &full, 0, 0},
        {"quiet", "no progress line", OPTION_FLAG, &quiet, 0, 0},
    };
    static report r;
    progress p;
    FILE *csv;
    options_parse(argc, argv, "CSPM, ICSPM and weighted least squares in two and three dimensions: convergence with boundaries.", specs, 4);
    report_open(&r, "icspm_dimensions", out);
    csv = figure_open(dir, "icspm_convergence");
    fprintf(csv, "dim,jitter,method,side,gradient,hessian,laplacian\n");
    for (dim = 2; dim <= 3; dim++)
        for (jittered = 0; jittered < 2; jittered++) {
            progress_begin(&p, dim == 2 ? "2D" : "3D", quiet);
            convergence(&r, csv, &p, dim, jittered ? 0.25 : 0, dim == 2 ? sides2 : sides3, (dim == 2 ? 4 : 3) + full);
            progress_end(&p);
        }
    figure_close(csv);
    return report_close(&r) ? 1 : 0;
}
