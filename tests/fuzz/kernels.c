/* SPDX-License-Identifier: MIT */
/*
 * kernels.c - fuzz target: all scalar functions of sph_kernels.h. In the documented range (r >= 0, h > 0, r / h < 1e9, and h so that h^-5, and F next to a cusp, are numbers): finite, 0 outside of the support, W >= 0 and W' <= 0
 * where that is promised, and derivatives that differences bear out; Akinci's kernels finite, and 0 outside. Outside of the range: no undefined behaviour.
 */
#include "fuzz.h"

#include "../../sph_kernels.h"

/* value(x + d) - value(x - d) over 2 d lies between the least and the largest slope in between; that of a function without jumps of its slope in there is near those at x - d, x, x + d. */
static int between(double difference, double a, double b, double c, double slack)
{
    const double low = fmin(a, fmin(b, c)), high = fmax(a, fmax(b, c));
    return difference >= low - slack && difference <= high + slack;
}

static void check_differences(sph_kernel k, int dim, sph_real q)
{
    const double support = (double)sph_kernel_support_ratio(k), d = SPH_SINGLE ? 1e-2 : 1e-4, x = (double)q, noise = (SPH_SINGLE ? 1e-2 : 1e-4);
    const sph_real h = SPH_R(1), a = SPH_R(x - d), b = SPH_R(x + d);
    const double width = (double)b - (double)a, W0 = fabs((double)sph_kernel_w(k, dim, SPH_R(0), h));
    double slope;
    if (x < 2 * d || fabs(x - support) < 2 * d) return; /* kernels may jump at the edge */
    slope = ((double)sph_kernel_w(k, dim, b, h) - (double)sph_kernel_w(k, dim, a, h)) / width;
    FUZZ_REQUIRE(between(slope, (double)sph_kernel_dwdr(k, dim, a, h), (double)sph_kernel_dwdr(k, dim, q, h), (double)sph_kernel_dwdr(k, dim, b, h), noise * W0));
    slope = ((double)sph_kernel_w(k, dim, q, SPH_R(1 + d)) - (double)sph_kernel_w(k, dim, q, SPH_R(1 - d))) / ((double)SPH_R(1 + d) - (double)SPH_R(1 - d));
    if (fabs(x / (1 + d) - support) > 4 * d && fabs(x / (1 - d) - support) > 4 * d)
        FUZZ_REQUIRE(between(slope, (double)sph_kernel_dwdh(k, dim, q, SPH_R(1 - d)), (double)sph_kernel_dwdh(k, dim, q, h), (double)sph_kernel_dwdh(k, dim, q, SPH_R(1 + d)), 30 * noise * W0));
    FUZZ_REQUIRE(fabs((double)sph_kernel_f(k, dim, q, h) * x - (double)sph_kernel_dwdr(k, dim, q, h)) <= noise * W0);
}

static void check_pair(sph_kernel k, int dim, sph_real r, sph_real h)
{
    const double support = (double)sph_kernel_support_ratio(k) * (double)h;
    const sph_real w = sph_kernel_w(k, dim, r, h), f = sph_kernel_f(k, dim, r, h);
    const sph_wf both = sph_kernel_wf(k, dim, r, h);
    FUZZ_REQUIRE(isfinite(w) && isfinite(f));
    FUZZ_REQUIRE(isfinite(both.w) && isfinite(both.f));
    FUZZ_REQUIRE(fabs((double)both.w - (double)w) <= 1e3 * (double)SPH_EPSILON * fabs((double)sph_kernel_w(k, dim, SPH_R(0), h)));
    FUZZ_REQUIRE(isfinite(sph_kernel_dwdr(k, dim, r, h)) && isfinite(sph_kernel_d2wdr2(k, dim, r, h)) && isfinite(sph_kernel_dwdh(k, dim, r, h)));
    FUZZ_REQUIRE(isfinite(sph_cohesion_kernel_akinci(r, h)) && isfinite(sph_adhesion_kernel_akinci(r, h)) && !(sph_adhesion_kernel_akinci(r, h) < SPH_R(0)));
    if ((double)r >= (double)h * (1 + 8 * (double)SPH_EPSILON)) FUZZ_REQUIRE(fabs((double)sph_cohesion_kernel_akinci(r, h)) + (double)sph_adhesion_kernel_akinci(r, h) <= 0.0);
    if (k != SPH_SUPER_GAUSSIAN && k != SPH_LIU_QUARTIC) FUZZ_REQUIRE(!(w < SPH_R(0)) && !(f > SPH_R(0)));
    if ((double)r >= support * (1 + 8 * (double)SPH_EPSILON)) {
        FUZZ_REQUIRE(!(w > SPH_R(0)) && !(w < SPH_R(0)) && !(f > SPH_R(0)) && !(f < SPH_R(0)));
        FUZZ_REQUIRE(fabs((double)sph_kernel_dwdh(k, dim, r, h)) <= 0.0 && fabs((double)sph_kernel_d2wdr2(k, dim, r, h)) <= 0.0);
    }
    if (sph_kernel_has_gravity(k)) {
        const sph_real phi = sph_gravity_potential(k, r, h), force = sph_gravity_force(k, r, h);
        FUZZ_REQUIRE(isfinite(phi) && isfinite(force) && isfinite(sph_gravity_dphidh(k, r, h)));
        FUZZ_REQUIRE(!(phi > SPH_R(0)) && !(force < SPH_R(0)));
        if ((double)r >= support * (1 + 8 * (double)SPH_EPSILON)) FUZZ_REQUIRE(fabs((double)phi * (double)r + 1.0) <= 16 * (double)SPH_EPSILON);
    }
}

/* any bits: the values do not matter, only that nothing undefined happens */
static volatile double sink;
static void check_anything(int k, int dim, sph_real r, sph_real h)
{
    const sph_kernel kernel = (sph_kernel)(k % (SPH_KERNEL_COUNT + 1));
    sink = (double)sph_kernel_w(kernel, dim, r, h) + (double)sph_kernel_dwdr(kernel, dim, r, h) + (double)sph_kernel_d2wdr2(kernel, dim, r, h) + (double)sph_kernel_dwdh(kernel, dim, r, h);
    sink = (double)sph_kernel_shape(kernel, dim, r) + (double)sph_kernel_shape_f(kernel, dim, r) + (double)sph_kernel_shape_d2(kernel, dim, r) + (double)sph_kernel_sigma(kernel, dim);
    sink = (double)sph_gravity_potential(kernel, r, h) + (double)sph_gravity_force(kernel, r, h) + (double)sph_gravity_dphidh(kernel, r, h);
    sink = (double)sph_cohesion_kernel_akinci(r, h) + (double)sph_adhesion_kernel_akinci(r, h);
    sink = (double)sph_kernel_h_from_support(kernel, r) + (double)sph_kernel_support(kernel, h) + (double)sph_kernel_h_over_dx(kernel);
}

static void check_names(fuzz_input *in)
{
    const char *const status = sph_status_text((int)fuzz_bits(in, 4));
    const size_t length = in->left < 40 ? in->left : 40;
    char *const name = (char *)fuzz_memory(length + 1, 1);
    int k;
    FUZZ_REQUIRE(status && status[0]);
    memcpy(name, in->data, length);
    name[length] = '\0';
    k = sph_kernel_from_name(name);
    FUZZ_REQUIRE(k >= -1 && k < SPH_KERNEL_COUNT);
    if (k >= 0) FUZZ_REQUIRE(sph_kernel_from_name(sph_kernel_name((sph_kernel)k)) == k);
    FUZZ_REQUIRE(sph_kernel_name((sph_kernel)(fuzz_byte(in) % (SPH_KERNEL_COUNT + 1))) != NULL);
    free(name);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    const int how = fuzz_below(&in, 4), k = (int)fuzz_byte(&in), dim = 1 + fuzz_below(&in, 3);
    if (how == 0) check_names(&in);
    else if (how == 1) check_anything(k, (int)(int8_t)fuzz_byte(&in), SPH_R(fuzz_any(&in)), SPH_R(fuzz_any(&in)));
    else {
        const sph_kernel kernel = (sph_kernel)(k % SPH_KERNEL_COUNT);
        const double h = fuzz_scale(&in, SPH_SINGLE ? 3.0 : 50.0), far = how == 2 ? 4.0 : 1e9 * fuzz_unit(&in), q = far * (double)fuzz_bits(&in, 7) / 72057594037927936.0;
        check_pair(kernel, dim, SPH_R(q * h), SPH_R(h));
        check_pair(kernel, dim, SPH_R((double)sph_kernel_support_ratio(kernel) * h), SPH_R(h)); /* the edge itself */
        if (how == 2) check_differences(kernel, dim, SPH_R(q));
    }
    return 0;
}
