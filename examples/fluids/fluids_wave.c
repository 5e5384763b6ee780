/* SPDX-License-Identifier: MIT
 *
 * fluids_wave.c - a standing wave in a viscous liquid: period and decay of its energy, by one method after the
 * other.
 *
 *     cc -O2 -o fluids_wave examples/fluids/fluids_wave.c -lm
 *     fluids_wave -out DIR -figures DIR [-full]       (-h for help)
 *
 * Depth H = 1, length 2 H, periodic in x, g = 1, k = pi; from a flat surface with the velocity of the potential
 *     phi = -(eps g H / (2 w)) cosh(k y) / cosh(k H) cos(k x),   w^2 = g k tanh(k H), eps = 0.1,
 * on a floor of Adami's ghosts along which the liquid slips. The kinetic energy is
 *     E = E0 exp(-4 nu k^2 t) (1 + cos(2 w t)) / 2
 * (linear waves; Colagrossi, Souto-Iglesias, Antuono & Marrone 2013, Phys. Rev. E 87, 023302, for the decay).
 * nu = H sqrt(gH) / 500, viscosity of Monaghan & Cleary, c0 = 10, h = 2 dx, 16 rows (-full: 32, too), 3 periods of
 * the energy. Figures: period in the exact one, from the minima of E; viscosity that its maxima show, in nu; noise.
 *
 * Morris's viscosity is here to be seen to fail. It dissipates mu |grad v|^2, where 2 mu D:D is right with
 * D = (grad v + grad v^T) / 2. Between walls, and in a periodic box, the two integrals are equal. In a wave, which
 * has a free surface and no curl, grad v = D, and Morris's viscosity dissipates half.
 */
#include "fluids.h"

enum { PERIOD, DECAY, NOISE, LOST };

static int rows = 16;
static const double nu = 1.0 / 500;
enum { SAMPLES = 4000 };
static double energy[SAMPLES], when[SAMPLES];
static int samples;

static double frequency(void) { return sqrt(MATH_PI * tanh(MATH_PI)); }
static void watch(flow *f)
{
    if (samples == SAMPLES) return;
    when[samples] = f->t;
    energy[samples++] = flow_kinetic_energy(f);
}
/* the time of the minimum near t, and the largest energy near it */
static double lowest_near(double t, double reach)
{
    double best = HUGE_VAL, at = (double)NAN;
    int s;
    for (s = 0; s < samples; s++)
        if (fabs(when[s] - t) < reach && energy[s] < best) {
            best = energy[s];
            at = when[s];
        }
    return at;
}
static double highest_near(double t, double reach)
{
    double best = 0;
    int s;
    for (s = 0; s < samples; s++)
        if (fabs(when[s] - t) < reach) best = fmax(best, energy[s]);
    return best;
}
static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    const double dx = 1.0 / rows, k = MATH_PI, w = frequency(), period = MATH_PI / w, size = 0.1 / (2 * w);
    double before;
    liquid l;
    int i, j, layers;
    liquid_open(&l, m, dx, 2 * dx, 10, 0);
    l.form = VISCOUS_MONAGHAN_CLEARY;
    l.f.gravity_y = -1;
    l.f.box_x = 2;
    l.surface = 1;
    l.speed = 0.1;
    for (j = 0; j < rows; j++)
        for (i = 0; i < 2 * rows; i++) {
            const double x = (i + 0.5) * dx, y = (j + 0.5) * dx;
            const int n = liquid_add(&l, x, y, 1 - y);
            l.f.vx[n] = size * k * cosh(k * y) / cosh(k) * sin(k * x);
            l.f.vy[n] = -size * k * sinh(k * y) / cosh(k) * cos(k * x);
        }
    layers = 4;
    for (j = 1; j <= layers; j++)
        for (i = 0; i < 2 * rows; i++) flow_add_ghost(&l.f, (i + 0.5) * dx, (0.5 - j) * dx, 0, dx * dx);
    liquid_start(&l, nu, o);
    l.w.slip = 1;
    liquid_shake(&l, seed);
    samples = 0;
    before = flow_kinetic_energy(&l.f);
    l.f.after = watch;
    watch(&l.f);
    flow_require(&l.f, flow_run(&l.f, 3.2 * period));
    /* the minima of E are at (n + 1/2) periods, its maxima at n periods */
    figure[PERIOD] = (lowest_near(2.5 * period, 0.4 * period) - lowest_near(0.5 * period, 0.4 * period)) / (2 * period);
    figure[DECAY] = log(highest_near(period, 0.3 * period) / highest_near(3 * period, 0.2 * period)) /
                    (4 * nu * k * k * 2 * period);
    figure[NOISE] = liquid_noise(&l);
    figure[LOST] = highest_near(3 * period, 0.2 * period) / before;
    liquid_end(&l, "wave", seed, o);
}

int main(int argc, char **argv)
{
#define FIGURES 4, {"period / exact", "viscosity / nu", "noise", "maximum of E / E0"}, {1.1, 1.5, 2, 1.5}, run, 0
    static const liquid_case cases[2] = {{"wave, 16 rows", FIGURES}, {"wave, 32 rows", FIGURES}};
    enum { PLAIN, ANTUONO, MORRIS, FOURTAKAS, SUN, RIEMANN, METHODS = RIEMANN + 3 };
    static const liquid_trial trial[METHODS] = {{METHOD_PLAIN, {0}, 0},
                                                {METHOD_ANTUONO, {0}, 0},
                                                {METHOD_ANTUONO_MORRIS, {0}, 0},
                                                {METHOD_FOURTAKAS, {0}, 0},
                                                {METHOD_SUN, {0}, 0},
                                                {METHOD_RIEMANN_GRAVITY, {0}, 0},
                                                {METHOD_MOLTENI, {0}, 1},
                                                {METHOD_RIEMANN, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x[2];
    int g;
    options_parse(argc, argv, "A standing wave, by one method after the other.", specs, FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_wave", o.out);
    figure_folder(o.figures, "fluids_wave");
    for (g = 0; g <= o.full; g++) {
        rows = g ? 32 : 16;
        report_section(&r, cases[g].item);
        liquid_compare(&r, &cases[g], trial, METHODS, &o, &x[g]);
        if (o.method) continue;
        report_relative(report_beside(&r, REPORT_THEORY), cases[g].item, "Antuono", "period / exact", 1,
                        x[g].figure[ANTUONO][PERIOD], 0.03);
        report_relative(report_beside(&r, REPORT_THEORY), cases[g].item, "Antuono, Monaghan & Cleary", "viscosity / nu", 1,
                        x[g].figure[ANTUONO][DECAY], 0.1);
        report_range(report_beside(&r, REPORT_THEORY), cases[g].item, "Antuono, Morris", "viscosity / nu: half of it", 0.5,
                     x[g].figure[MORRIS][DECAY], 0.4, 0.7);
    }
    return report_close(&r) ? 1 : 0;
}
