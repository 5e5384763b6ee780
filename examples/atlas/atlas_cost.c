/* SPDX-License-Identifier: MIT
 *
 * The atlas: what the operators cost, as multiples of a density by summation, with kernel and dimension as
 * constants, as in a user's program. atlas_operators reads the table. Times are the least of several, and a
 * density is timed beside each: a busy machine changes both.
 */
#include "../common/options.h"
#include "../common/report.h"
#include "../common/statistics.h"
#include "families.h"
#include "operators.h"

#include <time.h>

#define COST_KERNEL SPH_WENDLAND_C2

/* What a user's program shows to the compiler, too: no periods, one h for all, and a cloud that has been checked. */
SPH_FN sph_cloud shown(sph_cloud cloud)
{
    cloud.points.box.x = cloud.points.box.y = cloud.points.box.z = SPH_R(0);
    cloud.h.stride = 0;
    cloud.checked = 1;
    return cloud;
}

/* Sweeps that are in several lines of the table, and take seconds to compile: one copy of each. */
#define COST_ONCE(name, parameters, ...) \
    static sph_index once_##name parameters { return WITH_DIM_2_3(sph_##name, COST_KERNEL, dim, shown(cloud), __VA_ARGS__); }
static const sph_derivatives_options defaults = {SPH_R(0), 0}; /* what the table gives them; as constants they fold */
#define COST_DERIVATIVES (int dim, sph_cloud cloud, sph_scalars f, sph_derivatives_out out)
COST_ONCE(derivatives_cspm, COST_DERIVATIVES, f, defaults, out)
COST_ONCE(derivatives_icspm, COST_DERIVATIVES, f, defaults, out)
COST_ONCE(derivatives_fatehi_manzari, COST_DERIVATIVES, f, defaults, out)
COST_ONCE(derivatives_wls, COST_DERIVATIVES, f, defaults, out)
COST_ONCE(elliptic_msph, (int dim, sph_cloud cloud, sph_scalars m, sph_elliptic_options options, sph_scalars u, sph_scalar_out out), m, options, u, out)
COST_ONCE(fluid_rates_monaghan, (int dim, sph_cloud cloud, sph_fluid fluid, sph_fluid_out out), fluid, out)
COST_ONCE(fluid_rates_riemann, (int dim, sph_cloud cloud, sph_fluid fluid, sph_riemann_options options, sph_fluid_out out), fluid, options, out)
COST_ONCE(shift_displacement, (int dim, sph_cloud cloud, sph_shift shift, sph_vector_out out), shift, out)
#define sph_derivatives_cspm(k, dim, cloud, f, options, out) ((void)(k), once_derivatives_cspm(dim, cloud, f, out))
#define sph_derivatives_icspm(k, dim, cloud, f, options, out) ((void)(k), once_derivatives_icspm(dim, cloud, f, out))
#define sph_derivatives_fatehi_manzari(k, dim, cloud, f, options, out) ((void)(k), once_derivatives_fatehi_manzari(dim, cloud, f, out))
#define sph_derivatives_wls(k, dim, cloud, f, options, out) ((void)(k), once_derivatives_wls(dim, cloud, f, out))
#define sph_elliptic_msph(k, dim, ...) ((void)(k), once_elliptic_msph(dim, __VA_ARGS__))
#define sph_fluid_rates_monaghan(k, dim, ...) ((void)(k), once_fluid_rates_monaghan(dim, __VA_ARGS__))
#define sph_fluid_rates_riemann(k, dim, ...) ((void)(k), once_fluid_rates_riemann(dim, __VA_ARGS__))
#define sph_shift_displacement(k, dim, ...) ((void)(k), once_shift_displacement(dim, __VA_ARGS__))

/* the names that the expressions of the table use */
#define COST_CALL(dimension, id, expression) \
    static sph_index call_##dimension##_##id(views a) \
    { \
        enum { dim = dimension }; \
        const sph_kernel k = COST_KERNEL; \
        (void)k; \
        a.cloud = shown(a.cloud); \
        return expression; \
    }
#define COST_CALLS(id, function, family, list, formula, source, note, expression) COST_CALL(2, id, expression) COST_CALL(3, id, expression)
ATLAS_OPERATORS(COST_CALLS)
typedef struct row {
    const char *id;
    int family;
    sph_index (*call[2])(views a);
} row;
#define COST_ROW(id, function, family, list, formula, source, note, expression) {#id, family, {call_2_##id, call_3_##id}},
static const row rows[] = {ATLAS_OPERATORS(COST_ROW)};
enum { ROWS = sizeof rows / sizeof rows[0] };

static double seconds(sph_index (*call)(views a), views a)
{
    const clock_t begin = clock();
    expect(call(a));
    return (double)(clock() - begin) / CLOCKS_PER_SEC;
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0;
    const option_spec specs[] = {
        {"out", "directory of the table of results", OPTION_TEXT, &out, 0, 0},
        {"figures", "directory of the measured numbers, atlas_costs.csv", OPTION_TEXT, &figures, 0, 0},
        {"full", "more repetitions", OPTION_FLAG, &full, 0, 0},
    };
    part_file csv;
    report r;
    options_parse(argc, argv, "The atlas: what each operator costs beside a density.", specs, (int)(sizeof specs / sizeof specs[0]));
    report_open(&r, "atlas_cost", out);
    if (!part_file_open(&csv, figures, "atlas_costs", "csv")) {
        fprintf(stderr, "atlas_cost: cannot write %s: create the folder first\n", csv.part);
        return 2;
    }
    fprintf(csv.to, "operator,dim,ratio,ns\n");
    for (int dim = 2; dim <= 3; dim++) {
        const sample_wish wish = {SAMPLE_JITTER, 0, dim == 2 ? 72 : 20, 0.2, 1};
        const double h_dx = dim == 2 ? 2.0 : 1.6;
        sample s = sample_make(COST_KERNEL, dim, h_dx, wish);
        double *in[3], *field[6];
        char setting[64];
        snprintf(setting, sizeof setting, "%dD, %s, h = %.1f dx", dim, sph_kernel_name(COST_KERNEL), h_dx);
        for (int c = 0; c < 3; c++) in[c] = numbers(s.n);
        for (int c = 0; c < 6; c++) field[c] = numbers(s.n);
        sample_zoom(&s, 0.01);
        for (sph_index i = 0; i < s.n; i++) {
            const double x[3] = {s.x[0][i], s.x[1][i], s.x[2][i]};
            s.mobility[i] = 1.0;
            for (int c = 0; c < 3; c++) {
                const wave_field f = field_waves(dim, c);
                in[c][i] = field_at(&f, x).value + 3.0;
            }
        }
        for (int q = 0; q < (int)ROWS; q++) {
            double least = HUGE_VAL, density = HUGE_VAL;
            if (rows[q].family == GRAVITY && dim == 2) continue;
            for (int again = 0; again < (full ? 9 : 4); again++) {
                const views a = views_of(&s, in, field);
                density = fmin(density, seconds(dim == 2 ? call_2_density_summation : call_3_density_summation, a));
                least = fmin(least, seconds(rows[q].call[dim - 2], a));
            }
            fprintf(csv.to, "%s,%d,%.3f,%.2f\n", rows[q].id, dim, least / density, 1e9 * least / (double)s.n);
            report_info(&r, rows[q].id, setting, "time / time of a density", least / density);
        }
        for (int c = 0; c < 3; c++) free(in[c]);
        for (int c = 0; c < 6; c++) free(field[c]);
        sample_free(&s);
    }
    if (!part_file_close(&csv)) return 2;
    return report_close(&r) ? 1 : 0;
}
