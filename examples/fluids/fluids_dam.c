#include "fluids.h"
int main(int argc, char **argv)
{
    fluids_options o = {".", ".", 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static const liquid_method plain = {"plain", "fluids_dam_plain", 0};
    enum { SIDE = 20 };
    const double dx = 1.0 / SIDE;
    liquid l;
    int i, j, k;
    options_parse(argc, argv, "", specs, FLUIDS_OPTION_COUNT);
    liquid_open(&l, &plain, dx, 1.6 * dx, 20);
    l.f.gravity_y = -1;
    l.f.alpha = 0.02;
    for (j = 0; j < 2*SIDE; j++)
        for (i = 0; i < SIDE; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 2 - (j + 0.5) * dx);
    liquid_add_tank(&l, 4*SIDE, 3*SIDE);
    liquid_start(&l, 0, &o);
    for (k = 1; k <= 4; k++) {
        double front = 0, e = 0;
        flow_distribution d; flow_domain all = {0,0,0,0};
        flow_require(&l.f, flow_run(&l.f, k * .6));
        for (i = 0; i < l.f.n_fluid; i++) front = fmax(front, l.f.x[i]), e += l.f.m[i] * l.f.y[i];
        d = flow_measure(&l.f, FLOW_ALL, 0, all, NULL);
        printf("%g front %g noise %g E %g below .5 %g us %g\n", l.f.t, front, liquid_noise(&l), (e + flow_kinetic_energy(&l.f))/2, d.below_50, flow_microseconds(&l.f));
    }
    return 0;
}
