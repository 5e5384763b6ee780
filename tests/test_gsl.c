/* SPDX-License-Identifier: MIT */
/*
 * test_gsl.c - normalisation and slope of every kernel by the quadrature and the differences of the GNU Scientific Library, which share no code with
 * test_kernels.c. Optional: cc -std=c99 -I. tests/test_gsl.c -lgsl -lgslcblas -lm, where GSL is installed.
 *
 * In a build with SPH_SINGLE the integrands are rounded to float, which GSL takes for roughness: accuracies are asked for accordingly.
 */
#include "../sph_kernels.h"
#include "check.h"

#include <gsl/gsl_deriv.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <stdio.h>

#define PI 3.14159265358979323846

enum { INTERVALS = 1000 };

typedef struct which {
    sph_kernel kernel;
    int dim;
    double h;
} which;

static double density(double r, void *p)
{
    const which *a = (const which *)p;
    const double shell = a->dim == 1 ? 2.0 : a->dim == 2 ? 2.0 * PI * r : 4.0 * PI * r * r;
    return shell * (double)sph_kernel_w(a->kernel, a->dim, SPH_R(r), SPH_R(a->h));
}

static double value(double r, void *p)
{
    const which *a = (const which *)p;
    return (double)sph_kernel_w(a->kernel, a->dim, SPH_R(r), SPH_R(a->h));
}

static void test_integral(which *a, gsl_integration_workspace *space)
{
    const double epsilon = SPH_SINGLE ? 1e-6 : 1e-12, tolerance = SPH_SINGLE ? 3e-6 : 2e-12;
    const double edge = a->h * (double)sph_kernel_support_ratio(a->kernel);
    /* the knots of all kernels; those of others do no harm. The last one is the edge */
    static const double knot[] = {0.0, 0.5, 2.0 / 3.0, 1.0, 1.5, 2.0, 2.5, 3.0};
    double point[sizeof knot / sizeof knot[0] + 1], sum = 0.0, error = 0.0;
    size_t n = 0;
    gsl_function f;
    int status;
    f.function = density;
    f.params = a;
    while (n < sizeof knot / sizeof knot[0] && knot[n] * a->h < edge) {
        point[n] = knot[n] * a->h;
        n++;
    }
    point[n++] = edge;
    if (a->kernel == SPH_SCHUESSLER_SCHMITT) status = gsl_integration_qags(&f, 0.0, edge, epsilon, 0.0, INTERVALS, space, &sum, &error);
    else status = gsl_integration_qagp(&f, point, n, epsilon, 0.0, INTERVALS, space, &sum, &error);
    /* GSL_EROUND: rounding keeps it from the accuracy that was asked for; the result is judged all the same */
    if (!check_count((status == GSL_SUCCESS || status == GSL_EROUND) && fabs(sum - 1.0) <= tolerance))
        fprintf(stderr, "test_gsl.c: failed: integral of %s, dim %d, h %g: 1 %+.3g, error estimate %.3g, %s\n", sph_kernel_name(a->kernel), a->dim, a->h,
                sum - 1.0, error, gsl_strerror(status));
}

static double slope(double r, void *p)
{
    const which *a = (const which *)p;
    return (double)sph_kernel_dwdr(a->kernel, a->dim, SPH_R(r), SPH_R(a->h));
}

/* The integral of dW/dr between two multiples of 1/6 of q, on which all knots lie, is the difference of W. */
static void test_slope_integral(which *a)
{
    const double unit = (double)sph_kernel_w(a->kernel, a->dim, SPH_R(0), SPH_R(a->h)), epsilon = unit * (SPH_SINGLE ? 1e-6 : 1e-13);
    const int parts = (int)((double)sph_kernel_support_ratio(a->kernel) * 6.0 + 0.5);
    gsl_function f;
    int part;
    f.function = slope;
    f.params = a;
    /* not the first stretch, where the slope of schuessler-schmitt is infinite; not the end of the last one, where the Gaussians jump */
    for (part = 1; part < parts; part++) {
        const double from = (double)SPH_R(part / 6.0 * a->h), to = (double)SPH_R((part + (part + 1 < parts ? 1.0 : 0.999)) / 6.0 * a->h);
        const double want = value(to, a) - value(from, a);
        double got = 0.0, error = 0.0;
        size_t calls = 0;
        const int status = gsl_integration_qng(&f, from, to, epsilon, 0.0, &got, &error, &calls);
        if (!check_count(status == GSL_SUCCESS && fabs(got - want) <= epsilon))
            fprintf(stderr, "test_gsl.c: failed: integral of dW/dr of %s, dim %d, h %g, from %g to %g: %.15g, should be %.15g, off by %.3g, allowed %.3g, %s\n",
                    sph_kernel_name(a->kernel), a->dim, a->h, from, to, got, want, fabs(got - want), epsilon, gsl_strerror(status));
    }
}

/* In double only: gsl_deriv_central makes the step shorter until the rounding of float is all that it sees. */
static void test_slope(which *a)
{
    const double edge = (double)sph_kernel_support_ratio(a->kernel);
    const double unit = (double)sph_kernel_w(a->kernel, a->dim, SPH_R(0), SPH_R(a->h)) / a->h;
    gsl_function f;
    int part, i;
    f.function = value;
    f.params = a;
    for (part = 0; part < (int)(edge * 6.0 + 0.5); part++)
        for (i = 0; i < 2; i++) {
            const double r = (part + 0.4 + 0.2 * i) / 6.0 * a->h, got = slope(r, a);
            double want = 0.0, error = 0.0;
            const int status = gsl_deriv_central(&f, r, 1e-3 * a->h, &want, &error);
            const double allowed = 1e-9 * unit;
            if (!check_count(status == GSL_SUCCESS && fabs(got - want) <= allowed))
                fprintf(stderr, "test_gsl.c: failed: dW/dr of %s, dim %d, h %g, r %g: %.15g, by GSL %.15g +- %.2g, off by %.3g, allowed %.3g\n",
                        sph_kernel_name(a->kernel), a->dim, a->h, r, got, want, error, fabs(got - want), allowed);
        }
}

int main(void)
{
    static const double h[] = {1.0, 0.4375};
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(INTERVALS);
    which a;
    int k, j;
    gsl_set_error_handler_off();
    if (!space) {
        fprintf(stderr, "test_gsl: out of memory\n");
        return 1;
    }
    for (k = 0; k < SPH_KERNEL_COUNT; k++)
        for (a.dim = 1; a.dim <= 3; a.dim++)
            for (j = 0; j < 2; j++) {
                a.kernel = (sph_kernel)k;
                a.h = h[j];
                test_integral(&a, space);
                test_slope_integral(&a);
                if (!SPH_SINGLE) test_slope(&a);
            }
    gsl_integration_workspace_free(space);
    if (SPH_SINGLE) printf("test_gsl: float kernels: differences by GSL skipped, they would see rounding only\n");
    return check_report("test_gsl");
}
