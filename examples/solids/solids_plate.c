/* SPDX-License-Identifier: MIT
 *
 * solids_plate.c - a plate that is clamped at one end oscillates: its first frequency beside that of Euler &
 * Bernoulli, with and without hourglass control.
 *
 *     cc -O2 -o solids_plate examples/solids/solids_plate.c -lm
 *     solids_plate -out DIR -figures DIR [-full]       (-h for help)
 *
 * A plate of the length 10 and the thickness 1, plane strain, E (1 - nu) / ((1 + nu) (1 - 2 nu)) = 1, nu = 0.3,
 * density 1, h = dx. It starts straight, with the velocity of the first mode, so that its end moves by 2 % of
 * the length (Gray, Monaghan & Swift 2001, CMAME 190, 6641). The frequency is that of the time until it is
 * straight again. Euler & Bernoulli: omega = 1.8751^2 sqrt(D / (rho t)) / L^2, D = E t^3 / (12 (1 - nu^2)). A
 * thick plate is slower, by rotary inertia and shear: by 0.84 % here (Timoshenko's beam with k = 5/6, whose
 * equations were integrated numerically). The plate of particles is softer than either, because the stress at
 * its faces is not exactly 0: the more, the longer h is. The error falls with the second power of dx.
 */
#include "solids.h"

#define PLATE_LENGTH 10.0
static const double root = 1.8751040687119611;

/* the first mode, and 1 at the end of the plate */
static double mode(double x)
{
    const double z = root * x / PLATE_LENGTH, ratio = (sin(root) + sinh(root)) / (cos(root) + cosh(root));
    const double end = sin(root) - sinh(root) - ratio * (cos(root) - cosh(root));
    return (sin(z) - sinh(z) - ratio * (cos(z) - cosh(z))) / end;
}

typedef struct plate_result {
    double ratio, farthest, energy, rough; /* omega over that of Euler & Bernoulli; see main */
} plate_result;

static plate_result run(int rows, double h, double hourglass, const char *name, const solids_options *o)
{
    const double dx = 1.0 / rows, poisson = 0.3, young = (1 + poisson) * (1 - 2 * poisson) / (1 - poisson);
    const double thin = root * root * sqrt(young / (12 * (1 - poisson * poisson))) / (PLATE_LENGTH * PLATE_LENGTH);
    const int columns = (int)(PLATE_LENGTH * rows + 0.5), clamp = 3;
    const double amplitude = 0.02 * PLATE_LENGTH;
    plate_result r = {0, 0, 0, 0};
    double t = 0, dt, before = 0, kinetic;
    progress show;
    body b;
    int i, j, end = 0;
    body_open(&b, dx, h * dx, sph_elastic_of(young, poisson), BODY_NEO_HOOKEAN);
    b.hourglass = hourglass;
    for (i = -clamp; i < columns; i++)
        for (j = 0; j < rows; j++) {
            const int k = body_add(&b, (i + 0.5) * dx, (j + 0.5 - 0.5 * rows) * dx);
            if (i == columns - 1 && j == rows / 2) end = k;
        }
    body_start(&b);
    for (i = 0; i < b.n; i++) {
        b.held[i] = b.X[0][i] < 0;
        if (!b.held[i]) b.v[1][i] = amplitude * thin * mode(b.X[0][i]);
    }
    kinetic = body_sums(&b).kinetic;
    dt = body_time_step(&b);
    progress_begin(&show, "plate", o->quiet);
    for (;;) {
        double now;
        body_step(&b, dt);
        t += dt;
        now = b.x[1][end] - b.X[1][end];
        r.farthest = fmax(r.farthest, now / amplitude);
        if (before > 0 && now <= 0) {
            t -= dt * now / (now - before); /* straight, between two steps */
            break;
        }
        if (now > 0 && t * thin > 0.4 * MATH_PI && t * thin < 0.4 * MATH_PI + thin * dt * 1.5) body_write(&b, o->figures, name);
        before = now;
        progress_update(&show, t * thin / MATH_PI);
        if (t * thin > 2 * MATH_PI) break; /* never */
    }
    r.ratio = MATH_PI / t / thin;
    r.energy = body_sums(&b).kinetic / kinetic;
    for (i = 0; i < b.n; i++) { /* what is not smooth in the displacement: its value less that of the neighbours in the row */
        if (i >= rows * (clamp + 1) && i < b.n - rows) {
            const double middle = b.x[0][i] - 0.5 * (b.x[0][i - rows] + b.x[0][i + rows]);
            r.rough = fmax(r.rough, fabs(middle) / dx);
        }
    }
    body_close(&b);
    return r;
}

int main(int argc, char **argv)
{
    static const double thick = 0.99155;
    solids_options o = {".", ".", 0, 0};
    const option_spec specs[] = {SOLIDS_OPTIONS(o)};
    static report r;
    plate_result five, ten, bare, longer, fine;
    double limit;
    options_parse(argc, argv, "The first frequency of a plate that is clamped at one end.", specs,
                  SOLIDS_OPTION_COUNT);
    report_open(&r, "solids_plate", o.out);
    figure_folder(o.figures, "solids_plate");
    report_section(&r, "First frequency over that of Euler & Bernoulli");
    five = run(5, 1, 1, "solids_plate_5", &o);
    ten = run(10, 1, 1, "solids_plate_10", &o);
    bare = run(10, 1, 0, "solids_plate_10_bare", &o);
    longer = run(5, 1.3, 1, "solids_plate_5_longer", &o);
    limit = (4 * ten.ratio - five.ratio) / 3;
    report_range(report_beside(&r, REPORT_THEORY), "plate", "5 particles of thickness", "frequency", 1, five.ratio,
                 0.87, 1.02);
    report_range(report_beside(&r, REPORT_THEORY), "plate", "10 particles of thickness", "frequency", 1, ten.ratio,
                 0.97, 1.03);
    report_range(report_beside(&r, REPORT_THEORY), "plate", "10 particles, no hourglass control", "frequency", 1,
                 bare.ratio, 0.94, 1.02);
    report_range(report_beside(&r, REPORT_THEORY), "plate", "5 particles, h = 1.3 dx: softer", "frequency", 1,
                 longer.ratio, 0.83, 1.02);
    report_relative(report_beside(&r, REPORT_THEORY), "plate", "5 and 10, to the limit by dx^2",
                    "frequency of a thick plate", thick, limit, 0.02);
    report_range(&r, "plate", "10 particles of thickness", "farthest / that of the mode", (double)NAN, ten.farthest,
                 0.95, 1.1);
    report_range(&r, "plate", "10 particles of thickness", "kinetic energy after half a period", (double)NAN,
                 ten.energy, 0.97, 1.03);
    report_info(&r, "plate", "10 particles, no hourglass control", "kinetic energy after half a period", bare.energy);
    report_info(&r, "plate", "10 particles of thickness", "roughness / dx", ten.rough);
    report_info(&r, "plate", "10 particles, no hourglass control", "roughness / dx", bare.rough);
    if (o.full) {
        fine = run(20, 1, 1, "solids_plate_20", &o);
        report_range(report_beside(&r, REPORT_THEORY), "plate", "20 particles of thickness", "frequency", 1, fine.ratio,
                     0.96, 1.02);
        report_range(report_beside(&r, REPORT_THEORY), "plate", "20 particles of thickness", "order of convergence", 2,
                     log((ten.ratio - five.ratio) / (fine.ratio - ten.ratio)) / log(2.0), 1, 2.5);
    }
    return report_close(&r) ? 1 : 0;
}
