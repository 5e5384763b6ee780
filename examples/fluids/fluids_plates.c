/* SPDX-License-Identifier: MIT
 *
 * fluids_plates.c - Poiseuille and Couette flow between plates against their series: forms of physical viscosity,
 * and what other methods do to them.
 *
 *     cc -O2 -o fluids_plates examples/fluids/fluids_plates.c -lm
 *     fluids_plates -out DIR -figures DIR [-full]       (-h for help)
 *
 * The flows are those of clustering_flows (../papers/clustering_plates.h), which has Morris's viscosity with other
 * kernels and with collisions: Re = 1, from rest, plates of Adami's ghosts, hexagonal lattice with h = 1.5 times
 * its spacing, c0 = 10, 10 and 20 rows (-full: 40, too). Figures: rms error of the speed at t = 0.1 and 1, in the
 * largest speed of all, with 20 rows; order of the error at t = 1 from 10 to 20 rows; what has come into being of
 * a speed across the flow, which is 0; viscosity that the form has on the particles as they lie, in mu: its sums
 * over v = 4 y (1 - y), far from the plates, in the mean from t = 0.5 to 1.
 *
 * Forces along the lines between particles (Monaghan & Cleary; half of Espanol & Revenga's) meet two things here.
 *   The step. They resist compression with 3 mu, where Morris's form has mu, so that 0.125 h^2 / nu is too long for
 *   them: rows start to swing across the flow at t = 0.14, and lie unevenly ever after. Run to be seen to fail.
 *   The rows. On a hexagonal lattice the form has no direction, but rows that slide on each other pass through
 *   places where particles lie above each other, and there it gives less than mu.
 */
#include "fluids.h"
#include "../papers/clustering_plates.h"

enum { EARLY, LATE, ORDER, ACROSS, VISCOSITY };

static int couette, rows = 20, long_step;

/* The viscosity of a compression, in that of a shear, which limits the step: lambda + 2 mu of the form's stress. Forces
   along the lines between particles have lambda = mu. */
static double stiffness(const liquid_method *m)
{
    if (long_step) return 1;
    return m->viscosity == 1 + VISCOUS_MONAGHAN_CLEARY ? 3 : m->viscosity == 1 + VISCOUS_ESPANOL_REVENGA ? 2 : 1;
}
/* Of the form on the particles as they lie, in mu: its sums over a parabola, from t = 0.5 on, every 0.02. */
static double places_sum;
static int places_count;
static void watch(flow *f)
{
    viscous *const w = (viscous *)f->data;
    double sum = 0;
    int i, count = 0;
    if (f->t < 0.5 + 0.02 * places_count) return;
    for (i = 0; i < f->n; i++) {
        w->vx[i] = 4 * f->y[i] * (1 - f->y[i]);
        w->vy[i] = 0;
    }
    expect((sph_index)threads_each(f->n_fluid, viscous_accelerations_part, f));
    for (i = 0; i < f->n_fluid; i++)
        if (fabs(f->y[i] - 0.5) < 0.3) {
            sum -= w->ax[i] / 8;
            count++;
        }
    places_sum += sum / count;
    places_count++;
}
static void flow_between(const liquid_method *m, int seed, int across, const fluids_options *o, double *figure)
{
    const double dref = 1 / (across * hexagonal), c0 = 10;
    liquid l;
    int i;
    liquid_open(&l, m, dref, 1.5 * dref, c0, 0);
    l.f.dt = fmin(0.25 * l.f.h / (c0 + 1), 0.125 * l.f.h * l.f.h / stiffness(m));
    plates_fill(&l.f, couette, across);
    l.speed = 1;
    liquid_start(&l, 1, o);
    l.w.body_force = plates_force(couette);
    liquid_shake(&l, seed);
    places_sum = places_count = 0;
    l.f.after = watch;
    flow_require(&l.f, flow_run(&l.f, 0.1));
    figure[EARLY] = plates_error(&l.f, couette);
    flow_require(&l.f, flow_run(&l.f, 1));
    figure[LATE] = plates_error(&l.f, couette);
    figure[ACROSS] = 0;
    for (i = 0; i < l.f.n_fluid; i++) figure[ACROSS] = fmax(figure[ACROSS], fabs(l.f.vy[i]));
    figure[VISCOSITY] = places_sum / places_count;
    liquid_end(&l, couette ? "couette" : "poiseuille", seed, o);
}
static void run(const liquid_method *m, int seed, const fluids_options *o, double *figure)
{
    double coarse[LIQUID_FIGURES];
    flow_between(m, -1 - seed, rows / 2, o, coarse);
    flow_between(m, seed, rows, o, figure);
    figure[ORDER] = log(coarse[LATE] / figure[LATE]) / log(2.0);
}

int main(int argc, char **argv)
{
#define FIGURES 5, {"rms error, t = 0.1", "rms error, t = 1", "order, t = 1", "speed across", "viscosity of places"}, {2, 2, 2, 2, 2}, run, 0
    static const liquid_case cases[2][2] = {{{"Poiseuille", FIGURES}, {"Couette", FIGURES}},
                                            {{"Poiseuille, 40 rows", FIGURES}, {"Couette, 40 rows", FIGURES}}};
    enum { MORRIS, ESPANOL, CLEARY, ANTUONO, SUN, RIEMANN, METHODS = RIEMANN + 2 };
    static const liquid_trial trial[METHODS] = {{METHOD_MORRIS, {0}, 0},  {METHOD_ESPANOL, {0}, 0}, {METHOD_CLEARY, {0}, 0},
                                                {METHOD_ANTUONO, {0}, 0}, {METHOD_SUN, {0}, 0},
                                                {METHOD_RIEMANN, {0}, 0}, {METHOD_SUN_2019, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x;
    double figure[LIQUID_FIGURES];
    int t, k;
    options_parse(argc, argv, "Flows between plates against their series, by one method after the other.", specs,
                  FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_plates", o.out);
    figure_folder(o.figures, "fluids_plates");
    for (k = 0; k <= 2 * o.full + 1; k++) {
        const liquid_case *const now = &cases[k / 2][k % 2];
        couette = k % 2;
        rows = k < 2 ? 20 : 40;
        report_section(&r, now->item);
        liquid_compare(&r, now, trial, METHODS, &o, &x);
        for (t = 0; t < METHODS; t++)
            if (liquid_wanted(&trial[t], &o)) /* rows that slide: 0.95 mu, and the mean of that and Morris's */
                report_range(report_beside(&r, REPORT_THEORY), now->item, trial[t].method.name, "rms error at t = 1", 0,
                             x.figure[t][LATE], 0, t == CLEARY ? 0.06 : t == ESPANOL ? 0.045 : 0.03);
    }
    if (o.method) return report_close(&r) ? 1 : 0;
    report_section(&r, "Monaghan & Cleary with the step of Morris");
    couette = 0;
    long_step = 1;
    flow_between(&trial[CLEARY].method, -1, 20, &o, figure);
    report_range(&r, "Poiseuille", "Monaghan & Cleary, the step too long", "rms error at t = 1: it fails", (double)NAN,
                 figure[LATE], 0.1, 1);
    report_range(&r, "Poiseuille", "Monaghan & Cleary, the step too long", "viscosity of places", (double)NAN,
                 figure[VISCOSITY], 0.5, 0.9);
    return report_close(&r) ? 1 : 0;
}
