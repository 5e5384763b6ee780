/* SPDX-License-Identifier: MIT
 *
 * math.h - what the headers need of <math.h>, where there is no C library: WebAssembly, whose instructions
 * know roots and floors, but no exp. A native program that is compiled with it (-ffreestanding
 * -fno-math-errno, and this folder first) computes the same bits.
 */
#ifndef LAB_MATH_H
#define LAB_MATH_H

#define isfinite(x) __builtin_isfinite(x)
#define HUGE_VAL __builtin_inf()

/* with names of their own, because those of the library belong to the compiler */
#define sqrt(x) lab_sqrt(x)
#define fabs(x) lab_fabs(x)
#define floor(x) lab_floor(x)
#define copysign(x, y) lab_copysign(x, y)
#define fmax(x, y) lab_fmax(x, y)
#define fmin(x, y) lab_fmin(x, y)
#define exp(x) lab_exp(x)
#define log(x) lab_log(x)
#define pow(x, y) lab_pow(x, y)
#define sin(x) lab_sin(x)
#define cos(x) lab_cos(x)
#define acos(x) lab_acos(x)
#define atan2(y, x) lab_atan2(y, x)

static inline double lab_sqrt(double x) { return __builtin_sqrt(x); }
static inline double lab_fabs(double x) { return __builtin_fabs(x); }
static inline double lab_floor(double x) { return __builtin_floor(x); }
static inline double lab_copysign(double x, double y) { return __builtin_copysign(x, y); }
static inline double lab_fmax(double x, double y) { return x > y || y != y ? x : y; }
static inline double lab_fmin(double x, double y) { return x < y || y != y ? x : y; }

/* exp(x) = 2^k e^r with |r| <= log(2) / 2, e^r by its series. No branch and no division, so that sweeps with
   it vectorise. Below -708 it answers that of -708. */
static inline double lab_exp(double x)
{
    const double y = x < -708 ? -708 : x > 709 ? 709 : x, big = 6755399441055744.0;
    const double shifted = y * 1.44269504088896340736 + big, k = shifted - big;
    const double r = (y - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
    double s = 1.6059043836821613e-10;
    union {
        double number;
        long long bits;
    } from, to;
    s = 2.08767569878681e-09 + r * s;
    s = 2.505210838544172e-08 + r * s;
    s = 2.755731922398589e-07 + r * s;
    s = 2.7557319223985893e-06 + r * s;
    s = 2.48015873015873e-05 + r * s;
    s = 0.0001984126984126984 + r * s;
    s = 0.001388888888888889 + r * s;
    s = 0.008333333333333333 + r * s;
    s = 0.041666666666666664 + r * s;
    s = 0.16666666666666666 + r * s;
    s = 0.5 + r * s;
    from.number = shifted;
    to.bits = (from.bits + 1023) << 52;
    return to.number * (1 + r * (1 + r * s));
}
/* log(x) = k log(2) + log(m) with m between 0.7 and 1.4, by the series of 2 artanh((m - 1) / (m + 1)) */
static inline double lab_log(double x)
{
    union {
        double number;
        unsigned long long bits;
    } v;
    double f, z, s = 0;
    int k, i;
    v.number = x;
    if (!(x > 0)) return x == 0 ? -__builtin_inf() : __builtin_nan("");
    k = (int)(v.bits >> 52) - 1023;
    v.bits = (v.bits & 0xfffffffffffffull) | 0x3ff0000000000000ull;
    if (v.number > 1.41421356) {
        v.number *= 0.5;
        k++;
    }
    f = (v.number - 1) / (v.number + 1);
    z = f * f;
    for (i = 21; i > 1; i -= 2) s = z * (1.0 / i + s);
    return k * 6.93147180369123816490e-01 + (2 * f + (2 * f * s + k * 1.90821492927058770002e-10));
}
/* by squaring, where y is an integer below 64, as in Tait's equation */
static inline double lab_pow(double x, double y)
{
    double power = 1, square = x;
    int n = (int)lab_fabs(y < -64 ? 64 : y > 64 ? 64 : y);
    if (y != lab_floor(y) || n > 63) return lab_exp(y * lab_log(x));
    for (; n; n >>= 1) {
        if (n & 1) power *= square;
        square *= square;
    }
    return y < 0 ? 1 / power : power;
}
/* sin(x + quarters pi / 2), by its series within pi / 4; for |x| up to some thousands */
static inline double lab_sine(double x, int quarters)
{
    const double k = lab_floor(x * 0.63661977236758134308 + 0.5);
    const double r = (x - k * 1.57079632673412561417) - k * 6.07710050650619224932e-11, z = r * r;
    const int q = (int)(k - 4 * lab_floor(k / 4)) + quarters;
    double s = 0;
    int i;
    if (q & 1)
        for (i = 16; i > 0; i -= 2) s = (1 - s) * z / (i * (i - 1));
    else
        for (i = 17; i > 1; i -= 2) s = (1 - s) * z / (i * (i - 1));
    s = (q & 1 ? 1 : r) * (1 - s);
    return q & 2 ? -s : s;
}
static inline double lab_sin(double x) { return lab_sine(x, 0); }
static inline double lab_cos(double x) { return lab_sine(x, 1); }
/* 4 atan(z) with z = tan of a quarter of the angle, by its series */
static inline double lab_atan2(double y, double x)
{
    const double r = lab_sqrt(x * x + y * y), quarter = y / (r + x),
                 z = quarter / (1 + lab_sqrt(1 + quarter * quarter));
    double s = 0;
    int i;
    if (r == 0) return 0;
    if (x < 0) return lab_copysign(3.14159265358979324, y) - lab_atan2(y, -x);
    for (i = 35; i > 1; i -= 2) s = z * z * (1.0 / i - s);
    return 4 * (z - z * s);
}
static inline double lab_acos(double x) { return lab_atan2(lab_sqrt(1 - x * x), x); }
#endif
