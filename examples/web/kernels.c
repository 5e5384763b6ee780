/* SPDX-License-Identifier: MIT
 *
 * kernels.c - any kernel as curves: W and F, its Fourier transform, and what its sum over a lattice makes of
 * a density of 1.
 */
#ifndef SPH_FN
#define SPH_FN \
    static __attribute__((noinline, unused)) /* for any kernel: small code, which need not be fast */
#endif
#include "lab.h"

enum { POINTS = 241, CUTS = 200 };
enum { SHOW, KERNEL, DIM, H_OVER_DX, CONTROLS };
enum { SHAPES, TRANSFORM, LATTICE };
enum { RATIO, SIGMA, RECOMMENDED, NEIGHBOURS, LATTICE_SUM, LATTICE_SLOPE, LEAST, MEASURES };
static const double pi = 3.14159265358979324;

static lab_control controls[CONTROLS] = {
    {"show", "Show", "W and F|Fourier transform|density on a lattice", 0, 2, 1, 0, 0},
    {"kernel", "Kernel", LAB_KERNEL_NAMES, 0, SPH_KERNEL_COUNT - 1, 1, SPH_WENDLAND_C2, 0},
    {"dim", "Dimension", NULL, 1, 3, 1, 2, 0},
    {"h", "Smoothing length h / spacing", NULL, 0.8, 2.5, 0.05, 1.3, 0}};
static double x[POINTS], upper[POINTS], lower[POINTS];
static const char *const name[3][2] = {{"W(r) / W(0), over r / h", "-F(r) / largest -F"},
                                       {"transform of W, over k h", "0"},
                                       {"sum of V W over a lattice, over h / spacing", "1"}};
static lab_curve curves[2];
static lab_measure measures[MEASURES] = {{"support / h", 0},
                                         {"sigma", 0},
                                         {"recommended h / spacing", 0},
                                         {"neighbours on a lattice", 0},
                                         {"sum of V W there", 0},
                                         {"-(1 / dim) sum of V r^2 F there", 0},
                                         {"least value of the transform / that at 0", 0}};

/* What is left of a kernel with h = 1 along one axis, at the distance s: its integral across it.
   In 1D it is all. */
static double projected(sph_kernel k, int dim, double s)
{
    const double support = sph_kernel_support_ratio(k), rest = fmax(0, support * support - s * s);
    double sum = 0;
    int i;
    if (dim == 1) return sph_kernel_w(k, 1, s, 1);
    for (i = 0; i < CUTS; i++) { /* midpoints: in 2D of the length across, in 3D of its square */
        const double part = (i + 0.5) / CUTS, across2 = dim == 2 ? part * part * rest : part * rest;
        sum += sph_kernel_w(k, dim, sqrt(s * s + across2), 1);
    }
    return dim == 2 ? 2 * sqrt(rest) * sum / CUTS : pi * rest * sum / CUTS;
}
/* The transform of a kernel with h = 1 is that of its projection: the integral of it times cos(k x). */
static double transform(const double *projection, double support, double wave)
{
    double sum = 0;
    int i;
    for (i = 0; i < CUTS; i++) sum += projection[i] * cos(wave * (i + 0.5) * support / CUTS);
    return 2 * sum * support / CUTS;
}
/* sum V W and -(1 / dim) sum V r^2 F over a cubic lattice of the spacing 1: 1 is right. One of eight parts,
   whose sides and edges are shared. */
static void lattice(sph_kernel k, int dim, double h, double *sum, double *slope, double *count)
{
    const int far = (int)(sph_kernel_support(k, h) + 1), last_y = dim > 1 ? far : 0,
              last_z = dim > 2 ? far : 0;
    int i, j, l;
    *sum = *slope = *count = 0;
    for (i = 0; i <= far; i++)
        for (j = 0; j <= last_y; j++)
            for (l = 0; l <= last_z; l++) {
                const double r = sqrt((double)(i * i + j * j + l * l)),
                             many = (i ? 2 : 1) * (j ? 2 : 1) * (l ? 2 : 1);
                *sum += many * sph_kernel_w(k, dim, r, h);
                *slope -= many * r * r * sph_kernel_f(k, dim, r, h) / dim;
                *count += many * (r > 0 && r < sph_kernel_support(k, h));
            }
}
static int reset(void)
{
    const int show = (int)controls[SHOW].value, dim = (int)controls[DIM].value;
    const sph_kernel k = (sph_kernel)controls[KERNEL].value;
    const double support = sph_kernel_support_ratio(k);
    double projection[CUTS], whole, most = 0, slope, count;
    int i;
    for (i = 0; i < CUTS; i++) projection[i] = projected(k, dim, (i + 0.5) * support / CUTS);
    whole = transform(projection, support, 0);
    measures[RATIO].value = support;
    measures[SIGMA].value = sph_kernel_sigma(k, dim);
    measures[RECOMMENDED].value = sph_kernel_h_over_dx(k);
    lattice(k, dim, controls[H_OVER_DX].value, &measures[LATTICE_SUM].value, &measures[LATTICE_SLOPE].value,
            &measures[NEIGHBOURS].value);
    measures[LEAST].value = 1;
    for (i = 0; i < POINTS; i++) {
        const double at = i / (POINTS - 1.0), wave = transform(projection, support, 16 * at) / whole;
        measures[LEAST].value = fmin(measures[LEAST].value, wave);
        if (show == SHAPES) {
            x[i] = 1.05 * support * at;
            upper[i] = sph_kernel_w(k, dim, x[i], 1) / sph_kernel_w(k, dim, 0, 1);
            lower[i] = -sph_kernel_f(k, dim, fmax(x[i], 1e-3), 1);
            most = fmax(most, lower[i]);
        } else if (show == TRANSFORM) {
            x[i] = 16 * at;
            upper[i] = wave;
            lower[i] = 0;
        } else {
            x[i] = 0.8 + 1.7 * at;
            lattice(k, dim, x[i], &upper[i], &slope, &count);
            lower[i] = 1;
        }
    }
    for (i = 0; i < POINTS && show == SHAPES && most > 0; i++) lower[i] /= most;
    curves[0].name = name[show][0];
    curves[1].name = name[show][1];
    curves[0].y = upper;
    curves[1].y = lower;
    return 0;
}
static int changed(int control)
{
    if (control == KERNEL)
        controls[H_OVER_DX].value = sph_kernel_h_over_dx((sph_kernel)controls[KERNEL].value);
    return reset();
}
lab_scene lab_kernels = {
    .name = "kernels",
    .title = "Kernels",
    .about = "All kernels of the library. A kernel whose transform is nowhere negative does not let "
             "particles pair (Dehnen & Aly 2012); one whose lattice sum is 1 gives a lattice its density.",
    .reset = reset,
    .changed = changed,
    .controls = controls,
    .measures = measures,
    .curves = curves,
    .n_controls = CONTROLS,
    .n_measures = MEASURES,
    .n_curves = 2,
    .n_points = POINTS,
    .chosen = -1,
    .view = {0, 0, 1, 1},
    .curve_x = x,
};
