#include "fluids.h"
int main(int argc, char **argv)
{
    fluids_options o = {".", ".", 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static const liquid_method plain = {"plain", "fluids_dam_plain", 0};
    int SIDE = atoi(getenv("SIDE"));
    double hdx = atof(getenv("HDX")), t1 = atof(getenv("TEND"));
    const double dx = 1.0 / SIDE;
    liquid l;
    int i, j, k;
    options_parse(argc, argv, "", specs, FLUIDS_OPTION_COUNT);
    liquid_open(&l, &plain, dx, hdx * dx, 10);
    l.f.box_x = l.f.box_y = 1;
    for (j = 0; j < SIDE; j++)
        for (i = 0; i < SIDE; i++) {
            double x = 2 * MATH_PI * (i + 0.5) * dx, y = 2 * MATH_PI * (j + 0.5) * dx;
            k = liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, getenv("ZERO") ? 0 : -.25 * (cos(2 * x) + cos(2 * y)));
            l.f.vx[k] = -cos(x) * sin(y); l.f.vy[k] = sin(x) * cos(y);
        }
    liquid_start(&l, .01, &o);
    for (k = 1; k <= 4; k++) {
        double e = 0, decay;
        flow_distribution d; flow_domain all = {0,0,0,0};
        flow_require(&l.f, flow_run(&l.f, k * t1 / 4));
        decay = exp(-8 * MATH_PI * MATH_PI * .01 * l.f.t);
        for (i = 0; i < l.f.n_fluid; i++) { double x = 2 * MATH_PI * l.f.x[i], y = 2 * MATH_PI * l.f.y[i];
           e += hypot(l.f.vx[i] + cos(x) * sin(y) * decay, l.f.vy[i] - sin(x) * cos(y) * decay) / decay / l.f.n_fluid; }
        d = flow_measure(&l.f, FLOW_ALL, 0, all, NULL);
        printf("%g noise %g err %g E %g (%g) least %g us %g\n", l.f.t, liquid_noise(&l), e, flow_kinetic_energy(&l.f)*4, decay * decay, d.least, flow_microseconds(&l.f));
    }
    return 0;
}
