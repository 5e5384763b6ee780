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
 * a speed across the flow, which is 0.
 */
#include "fluids.h"
#include "../papers/clustering_plates.h"

enum { EARLY, LATE, ORDER, ACROSS };

static int couette, rows = 20;

static void flow_between(const liquid_method *m, int seed, int across, const fluids_options *o, double *figure)
{
    const double dref = 1 / (across * hexagonal), c0 = 10;
    liquid l;
    int i;
    liquid_open(&l, m, dref, 1.5 * dref, c0, 0);
    l.f.dt = fmin(0.25 * l.f.h / (c0 + 1), 0.125 * l.f.h * l.f.h);
    plates_fill(&l.f, couette, across);
    l.speed = 1;
    liquid_start(&l, 1, o);
    l.w.body_force = plates_force(couette);
    liquid_shake(&l, seed);
    flow_require(&l.f, flow_run(&l.f, 0.1));
    figure[EARLY] = plates_error(&l.f, couette);
    flow_require(&l.f, flow_run(&l.f, 1));
    figure[LATE] = plates_error(&l.f, couette);
    figure[ACROSS] = 0;
    for (i = 0; i < l.f.n_fluid; i++) figure[ACROSS] = fmax(figure[ACROSS], fabs(l.f.vy[i]));
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
#define FIGURES 4, {"rms error, t = 0.1", "rms error, t = 1", "order, t = 1", "speed across"}, {2, 2, 2, 2}, run
    static const liquid_case cases[2] = {{"Poiseuille", FIGURES}, {"Couette", FIGURES}};
    enum { MORRIS, ESPANOL, CLEARY, ANTUONO, SUN, RIEMANN, METHODS = RIEMANN + 2 };
    static const liquid_trial trial[METHODS] = {{METHOD_MORRIS, {0}, 0},  {METHOD_ESPANOL, {0}, 0}, {METHOD_CLEARY, {0}, 0},
                                                {METHOD_ANTUONO, {0}, 0}, {METHOD_SUN, {0}, 0},
                                                {METHOD_RIEMANN, {0}, 0}, {METHOD_SUN_2019, {0}, 1}};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static liquid_results x;
    int t;
    options_parse(argc, argv, "Flows between plates against their series, by one method after the other.", specs,
                  FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_plates", o.out);
    figure_folder(o.figures, "fluids_plates");
    for (couette = 0; couette < 2; couette++) {
        rows = 20;
        report_section(&r, cases[couette].item);
        liquid_compare(&r, &cases[couette], trial, METHODS, &o, &x);
        for (t = 0; t < METHODS; t++)
            if (liquid_wanted(&trial[t], &o) && t != CLEARY && t != ESPANOL)
                report_range(report_beside(&r, REPORT_THEORY), cases[couette].item, trial[t].method.name,
                             "rms error at t = 1, 20 rows", 0, x.figure[t][LATE], 0, 0.03);
    }
    return report_close(&r) ? 1 : 0;
}
