/* SPDX-License-Identifier: MIT */
/*
 * eva.c - every function of sph_kernels.h on intervals that together are its whole range, for Eva, the abstract interpreter of Frama-C: for no r and h in there does an operation overflow, divide by zero, give a
 * number that is not finite, or read what was not set. lint.sh runs it, in double and in float.
 *
 * The range: all kernels, also the one that is none; dim 1, 2, 3; r / h from 0 to 1e9; h from 1e-20 to 1e20 (in float from 1e-3 to 1e3), so that F next to a cusp, up to 1e150 / h^5 (1e18 / h^5), is a number.
 */
#include "__fc_builtin.h"
#include "sph_kernels.h"

/* The one thing that intervals cannot see: x + |x| is exactly 0 or 2 x. Eva takes this for the function. */
/*@ assigns \result \from x;
    behavior negative: assumes x <= 0; ensures \is_finite(\result) && \result == 0;
    behavior positive: assumes x >= 0; ensures \is_finite(\result) && \result == x;
    complete behaviors; */
static sph_real sphi_pos(sph_real x);

#if SPH_SINGLE
static sph_real between(sph_real a, sph_real b) { return Frama_C_float_interval(a, b); }
static const sph_real narrowest = 1e-3f, widest = 1e3f, wider = 2, further = 1e2f;
#else
static sph_real between(sph_real a, sph_real b) { return Frama_C_double_interval(a, b); }
static const sph_real narrowest = 1e-20, widest = 1e20, wider = 100, further = 1e10;
#endif

static void at(sph_real r, sph_real h)
{
    static const sph_kernel softened[] = {SPH_CUBIC_SPLINE, SPH_WENDLAND_C2, SPH_WENDLAND_C4, SPH_WENDLAND_C6};
    const int dim = Frama_C_interval(1, 3);
    const sph_kernel any = (sph_kernel)Frama_C_interval(0, SPH_KERNEL_COUNT);
    int i;
    sph_kernel_w(any, dim, r, h);
    sph_kernel_f(any, dim, r, h);
    sph_kernel_wf(any, dim, r, h);
    sph_kernel_dwdr(any, dim, r, h);
    sph_kernel_d2wdr2(any, dim, r, h);
    sph_kernel_dwdh(any, dim, r, h);
    sph_cohesion_kernel_akinci(r, h);
    sph_adhesion_kernel_akinci(r, h);
    for (i = 0; i < 4; i++) {
        sph_gravity_potential(softened[i], r, h);
        sph_gravity_force(softened[i], r, h);
        sph_gravity_dphidh(softened[i], r, h);
    }
}

/* q0 <= r / h <= q1, for all h */
static void strip(sph_real q0, sph_real q1)
{
    sph_real h;
    for (h = narrowest; h < widest; h *= wider) at(between(q0 * h, q1 * h * wider), between(h, h * wider));
}

static void names(void)
{
    char text[24];
    int k;
    Frama_C_make_unknown(text, sizeof text - 1);
    text[sizeof text - 1] = '\0';
    sph_kernel_from_name(text);
    sph_kernel_from_name(NULL);
    sph_status_text(Frama_C_interval(-2147483647 - 1, 2147483647));
    for (k = 0; k <= SPH_KERNEL_COUNT; k++) {
        const sph_kernel kernel = (sph_kernel)k;
        sph_kernel_name(kernel);
        sph_kernel_has_cusp(kernel);
        sph_kernel_h_over_dx(kernel);
        sph_kernel_support(kernel, between(narrowest, widest));
        if (k < SPH_KERNEL_COUNT) {
            sph_kernel_h_from_support(kernel, between(narrowest, widest));
            sph_kernel_may_convexify(kernel, Frama_C_interval(1, 3));
        }
    }
}

int main(void)
{
    sph_real q;
    strip(0, SPHI_TINY);
    for (q = SPHI_TINY; q < 1; q *= further) strip(q, q * further);
    strip(1, 8);
    strip(8, 1e9f);
    names();
    return 0;
}
