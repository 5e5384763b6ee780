#include "fluids.h"
int main(int argc, char **argv)
{
    fluids_options o = {".", ".", 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static const liquid_method plain = {"plain", "fluids_dam_plain", 0};
    enum { SIDE = 40 };
    const double dx = 1.0 / SIDE;
    liquid l;
    int i, j, k, m, n;
    options_parse(argc, argv, "", specs, FLUIDS_OPTION_COUNT);
    liquid_open(&l, &plain, dx, 2 * dx, 7);
    for (j = 0; j < SIDE; j++)
        for (i = 0; i < SIDE; i++) {
            double x = (i + 0.5) * dx, y = (j + 0.5) * dx, p = 0;
            for (m = 1; m < 40; m += 2) for (n = 1; n < 40; n += 2) p -= 32 / (pow(MATH_PI, 4) * m * n * (m * m + n * n)) * sin(m * MATH_PI * x) * sin(n * MATH_PI * y);
            if (getenv("ZERO")) p = 0;
            k = liquid_add(&l, x, y, p);
            l.f.vx[k] = y - .5; l.f.vy[k] = -(x - .5);
        }
    l.f.alpha = atof(getenv("ALPHA"));
    liquid_start(&l, 0, &o);
    for (k = 1; k <= 4; k++) {
        flow_distribution d; flow_domain all = {0,0,0,0};
        flow_require(&l.f, flow_run(&l.f, k * .5));
        d = flow_measure(&l.f, FLOW_ALL, 0, all, NULL);
        printf("%g noise %g E %g below .5 %g us %g\n", l.f.t, liquid_noise(&l), flow_kinetic_energy(&l.f)*12, d.below_50, flow_microseconds(&l.f));
    }
    return 0;
}
