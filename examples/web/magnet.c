/* SPDX-License-Identifier: MIT
 *
 * magnet.c - a magnetic field into which a pointer paints a divergence, and from which it is cleaned, as in
 * ../clean_field.c: dB/dt = -grad psi, dpsi/dt = -ch^2 div B - sigma ch psi / h. Nothing moves.
 */
#include "lab.h"

enum { DIM = 2, SIDE = 64, MOST = SIDE * SIDE };
enum { CLEANING, SIGMA, BRUSH, REACH, ACROSS, CONTROLS };
enum { DIV_B, PSI, STRENGTH, FIELDS };
enum { DIVERGENCE, ENERGY, MEAN_BX, MEASURES };
#define KERNEL SPH_QUINTIC_SPLINE
static const double ch = 1, one = 1;

static lab_control controls[CONTROLS] = {{"cleaning", "Cleaning", "off|on", 0, 1, 1, 1, 0},
                                         {"sigma", "Damping sigma", NULL, 0, 2, 0.05, 0.3, 0},
                                         {"brush", "The pointer paints", "a source|a sink", 0, 1, 1, 0, 0},
                                         {"reach", "Radius of the brush", NULL, 0.05, 0.3, 0.01, 0.12, 0},
                                         {"across", "Particles in a row", NULL, 20, SIDE, 2, 50, 0}};
static double x[MOST], y[MOST], rho[MOST], Bx[MOST], By[MOST], psi[MOST], rate_x[MOST], rate_y[MOST],
    rate_psi[MOST], div_B[MOST], h_div_B[MOST], strength[MOST], h, m;
static int n;
static sph_cloud cloud;

static int rates(void)
{
    sph_cleaning state = {0};
    sph_cleaning_out out = {0};
    state.medium.m = sph_scalars_same(&m);
    state.medium.rho = sph_scalars_array(rho);
    state.medium.omega = sph_scalars_same(&one);
    state.field = sph_vectors_separate(Bx, By, NULL);
    state.psi = sph_scalars_array(psi);
    state.ch = ch;
    state.sigma = controls[SIGMA].value;
    out.rate_B = sph_vector_out_separate(rate_x, rate_y, NULL);
    out.rate_psi = rate_psi;
    out.div_B = div_B;
    LAB_TRY(sph_cleaning_rates(KERNEL, DIM, cloud, state, out));
    return 0;
}
/* adds a field that runs out of a disc's middle, or into it: strength
   (p - middle) / reach (1 - (r / reach)^2)^2 */
static void paint(double px, double py, double much)
{
    const double reach = controls[REACH].value;
    int i;
    for (i = 0; i < n; i++) {
        double sx = x[i] - px, sy = y[i] - py, q;
        sx -= floor(sx + 0.5);
        sy -= floor(sy + 0.5);
        q = fmax(0, 1 - (sx * sx + sy * sy) / (reach * reach));
        Bx[i] += much * sx / reach * q * q;
        By[i] += much * sy / reach * q * q;
    }
}
static int reset(void)
{
    const int across = (int)controls[ACROSS].value;
    const double dx = 1.0 / across;
    double radius;
    sph_points points;
    sph_list list = {NULL, NULL};
    int i;
    n = across * across;
    h = dx;
    m = 1.0 / n;
    lab_seed(5);
    for (i = 0; i < n; i++) { /* a hexagonal lattice, slightly in disorder */
        const double jx = 0.1 * lab_random(), jy = 0.1 * lab_random();
        x[i] = (i % across + 0.25 + 0.5 * (i / across % 2) + jx) * dx;
        y[i] = (i / across + 0.5 + jy) * dx;
        Bx[i] = psi[i] = 0;
        By[i] = 0.5;
    }
    paint(0.5, 0.5, 0.6);
    radius = sph_kernel_support(KERNEL, h);
    points = sph_points_periodic(sph_points_separate(n, x, y, NULL), 1, 1, 0);
    LAB_TRY(lab_neighbours(DIM, points, sph_scalars_same(&radius), SPH_GATHER, &list));
    cloud = sph_cloud_checked(DIM, sph_cloud_of(points, list, sph_scalars_same(&h), sph_scalars_none()));
    LAB_TRY(sph_density_summation(KERNEL, DIM, cloud, sph_scalars_same(&m), sph_scalar_out_array(rho, NULL)));
    lab_magnet.n = lab_magnet.n_moving = n;
    lab_magnet.time = 0;
    lab_magnet.size = dx;
    return rates();
}
static int step(void) /* the midpoint rule: first half a step */
{
    static double Bx0[MOST], By0[MOST], psi0[MOST];
    const double dt = 0.3 * h / ch;
    int i, part;
    for (i = 0; i < n; i++) {
        Bx0[i] = Bx[i];
        By0[i] = By[i];
        psi0[i] = psi[i];
    }
    for (part = 1; part <= 2 && controls[CLEANING].value > 0; part++) {
        const double to = 0.5 * part * dt;
        LAB_TRY(rates());
        for (i = 0; i < n; i++) {
            Bx[i] = Bx0[i] + to * rate_x[i];
            By[i] = By0[i] + to * rate_y[i];
            psi[i] = psi0[i] + to * rate_psi[i];
        }
    }
    lab_magnet.time += dt;
    return 0;
}
static lab_field fields[FIELDS] = {
    {"h div B", h_div_B, -0.05, 0.05}, {"psi", psi, -0.05, 0.05}, {"|B|", strength, 0, 1}};
static lab_measure measures[MEASURES] = {
    {"rms of h div B", 0}, {"energy of B and psi", 0}, {"mean of Bx, which is conserved", 0}};
static int look(void)
{
    double sum = 0;
    int i;
    LAB_TRY(rates());
    measures[ENERGY].value = measures[MEAN_BX].value = 0;
    for (i = 0; i < n; i++) {
        h_div_B[i] = h * div_B[i];
        strength[i] = sqrt(Bx[i] * Bx[i] + By[i] * By[i]);
        sum += h_div_B[i] * h_div_B[i] / n;
        measures[ENERGY].value +=
            m * (strength[i] * strength[i] + psi[i] * psi[i] / (ch * ch)) / (2 * rho[i]);
        measures[MEAN_BX].value += m * Bx[i] / rho[i];
    }
    measures[DIVERGENCE].value = sqrt(sum);
    return 0;
}
static int changed(int control) { return control == ACROSS ? reset() : 0; }
static int point(int phase, double px, double py)
{
    if (phase != LAB_UP)
        paint(px, py, (controls[BRUSH].value > 0 ? -1 : 1) * (phase == LAB_DOWN ? 0.5 : 0.1));
    return 0;
}
lab_scene lab_magnet = {
    .name = "magnet",
    .title = "A field to clean",
    .about = "A magnetic field has no divergence. Paint some, and watch how cleaning carries it away as "
             "waves of psi, and damps them; switched off, it stays where it is.",
    .hint = "Press and move to paint a divergence.",
    .reset = reset,
    .step = step,
    .look = look,
    .changed = changed,
    .point = point,
    .controls = controls,
    .fields = fields,
    .measures = measures,
    .n_controls = CONTROLS,
    .n_fields = FIELDS,
    .n_measures = MEASURES,
    .chosen = -1,
    .view = {-0.06, -0.04, 1.6, 1.08},
    .x = x,
    .y = y,
};
