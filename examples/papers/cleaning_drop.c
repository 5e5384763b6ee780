/* SPDX-License-Identifier: MIT
 *
 * cleaning_drop.c - the oscillating drop of the paper on divergence cleaning: section IV-D, figures 7 to 10. Weakly compressible SPH with and without velocity cleaning.
 *
 *     cc -O2 -o cleaning_drop examples/papers/cleaning_drop.c -lm
 *     cleaning_drop -out DIR -figures DIR [-full]       (-h for help)
 *
 * 1976 particles of a square lattice in the unit disc, rho0 = 1000, v = (-100 x, 100 y), acceleration -100^2 r, h = 1.2 dx constant, the equation of state (26) with cs = 1000, density by (28) from rho0 on.
 * Cleaning: ch = cs, sigma = 0.3; psi is a pressure beside p. dt = 0.3 h / sqrt(cs^2 + ch^2). The paper names neither cs, ch, sigma, dt nor the viscosity, on which its figures depend.
 * Without a boundary layer the drop stays an ellipse with the axes exp(-theta), exp(theta): theta'' = -(theta'^2 + w^2) tanh 2 theta, to which the runs are compared.
 */
#ifndef SPH_CHECK
#define SPH_CHECK 0 /* the sweeps find what is not finite, and the run says where */
#endif
#include "cleaning.h"

enum { X, Y, VX, VY, RHO, PSI, P, AX, AY, DIVV, LISTED_X, LISTED_Y, ARRAYS };

static const double rho0 = 1000, w = 100, cs = 1000, sigma = 0.3;
static const double h = CLEANING_ETA * CLEANING_SPACING;
static const double skin =
    0.3 * CLEANING_ETA * CLEANING_SPACING; /* lists hold more than a step needs, and last for some */

typedef struct drop {
    int n, cleans, viscosity;
    double alpha, m, ch;
    double *a[ARRAYS];
    search near;
    const char *run; /* what it is called, and its time: for messages */
    double t;
} drop;

static sph_points points(const drop *d) { return sph_points_separate(d->n, d->a[X], d->a[Y], NULL); }

/* The sweeps find a state that is no number. */
static void well(const drop *d, sph_index answer)
{
    static const char *const name[] = {"x", "y", "vx", "vy", "density", "psi", "pressure"};
    expect_finite(answer, d->run, d->t, d->a, name, P + 1, points(d));
}

/* New lists where particles have moved by half of the skin */
static void neighbours(drop *d)
{
    const double radius = sph_kernel_support_ratio(SPH_CUBIC_SPLINE) * h + skin;
    int i;
    int due = 1;
    if (d->near.found.list.start)
        due = sph_rebuild_due(2, points(d), sph_points_separate(d->n, d->a[LISTED_X], d->a[LISTED_Y], NULL),
                              skin);
    if (due < 0) well(d, due);
    if (due == 0) return;
    search_all(&d->near, 2, points(d), sph_scalars_same(&radius), SPH_LARGER);
    for (i = 0; i < d->n; i++) {
        d->a[LISTED_X][i] = d->a[X][i];
        d->a[LISTED_Y][i] = d->a[Y][i];
    }
}

static sph_cloud cloud(const drop *d)
{
    return sph_cloud_of(points(d), d->near.found.list, sph_scalars_same(&h), sph_scalars_none());
}
/* (27), (39): accelerations by the pressure in P; artificial viscosity where wanted */
SPH_FN sph_index accelerate_by(int viscosity, drop *d)
{
    sph_fluid f = {0};
    f.m = sph_scalars_same(&d->m);
    f.rho = sph_scalars_array(d->a[RHO]);
    f.p = sph_scalars_array(d->a[P]);
    f.c = sph_scalars_same(&cs);
    f.v = vectors_of(d->a + VX, 2);
    f.viscosity = viscosity;
    f.alpha = d->alpha;
    f.beta = viscosity == (int)SPH_VISCOSITY_MONAGHAN
                 ? 2 * d->alpha
                 : 2; /* of 1992: beside alpha; of 1997: within alpha v_sig */
    f.eta = 0.1;
    return sph_fluid_rates_monaghan(SPH_CUBIC_SPLINE, 2, cloud(d), f,
                                    (sph_fluid_out){.acceleration = vectors_into(d->a + AX, 2)});
}
/* The sweep folds for a constant viscosity, too. */
static void accelerate(drop *d, int viscosity)
{
    well(d, viscosity == SPH_VISCOSITY_SIGNAL     ? accelerate_by(SPH_VISCOSITY_SIGNAL, d)
            : viscosity == SPH_VISCOSITY_MONAGHAN ? accelerate_by(SPH_VISCOSITY_MONAGHAN, d)
                                                  : accelerate_by(SPH_VISCOSITY_NONE, d));
}
static void forces(drop *d)
{
    const sph_tait water = {.rho0 = rho0, .c = cs, .gamma = 7};
    int i;
    neighbours(d);
    for (i = 0; i < d->n; i++) d->a[P][i] = sph_pressure_tait(d->a[RHO][i], water) + d->a[PSI][i];
    accelerate(d, d->alpha > 0 ? d->viscosity : (int)SPH_VISCOSITY_NONE);
    for (i = 0; i < d->n; i++) {
        d->a[AX][i] -= w * w * d->a[X][i];
        d->a[AY][i] -= w * w * d->a[Y][i];
    }
}
/* (36); the rate of the density (28) is -rho times it */
static void divergence(drop *d)
{
    static const double one = 1;
    sph_medium g;
    g.m = sph_scalars_same(&d->m);
    g.rho = sph_scalars_array(d->a[RHO]);
    g.omega = sph_scalars_same(&one);
    neighbours(d);
    well(d, sph_divergence_difference(SPH_CUBIC_SPLINE, 2, cloud(d), g, vectors_of(d->a + VX, 2),
                                      sph_scalar_out_array(d->a[DIVV], 0)));
}

static drop drop_new(double alpha, int viscosity, int cleans)
{
    double *const none[3] = {NULL, NULL, NULL};
    double *place[3] = {NULL, NULL, NULL};
    drop d = {0};
    int i;
    d.n = cleaning_ball(2, CLEANING_SPACING, none);
    d.m = rho0 * CLEANING_SPACING * CLEANING_SPACING;
    d.alpha = alpha;
    d.viscosity = viscosity;
    d.cleans = cleans;
    d.run = "a drop";
    d.ch = cleans ? cs : 0;
    d.a[0] = (double *)need_zeros((size_t)ARRAYS * (size_t)d.n, sizeof(double));
    for (i = 1; i < ARRAYS; i++) d.a[i] = d.a[0] + i * d.n;
    place[0] = d.a[X];
    place[1] = d.a[Y];
    cleaning_ball(2, CLEANING_SPACING, place);
    for (i = 0; i < d.n; i++) {
        d.a[VX][i] = -w * d.a[X][i];
        d.a[VY][i] = w * d.a[Y][i];
        d.a[RHO][i] = rho0;
    }
    forces(&d);
    return d;
}
static void drop_close(drop *d)
{
    free(d->a[0]);
    search_close(&d->near);
}

/* Kick, half a drift, density and psi with the velocity and the places of the middle, half a drift, kick: reversible and of second order without viscosity and damping, and momentum and angular momentum
   change by rounding errors only. Viscous forces are those of the velocity half a step ago. psi is damped by exp(-sigma ch dt / (2 h)) on both sides. */
static void advance(drop *d, double dt)
{
    const double damping = exp(-sigma * d->ch * 0.5 * dt / h);
    const sph_cleaning_wave undamped = {.ch = d->ch, .h = h};
    int i;
    for (i = 0; i < d->n; i++) {
        d->a[VX][i] += 0.5 * dt * d->a[AX][i];
        d->a[VY][i] += 0.5 * dt * d->a[AY][i];
        d->a[X][i] += 0.5 * dt * d->a[VX][i];
        d->a[Y][i] += 0.5 * dt * d->a[VY][i];
    }
    divergence(d);
    for (i = 0; i < d->n; i++) {
        const double rate = -d->a[RHO][i] * d->a[DIVV][i];
        d->a[RHO][i] += dt * rate;
        if (d->cleans)
            d->a[PSI][i] =
                damping * (damping * d->a[PSI][i] + dt * sph_cleaning_rate_velocity(undamped, 0, rate));
        d->a[X][i] += 0.5 * dt * d->a[VX][i];
        d->a[Y][i] += 0.5 * dt * d->a[VY][i];
    }
    forces(d);
    for (i = 0; i < d->n; i++) {
        d->a[VX][i] += 0.5 * dt * d->a[AX][i];
        d->a[VY][i] += 0.5 * dt * d->a[AY][i];
    }
}

/* ---------------------------------------------------------------- what is measured */

enum { SAMPLES = 200, SHORT = 50 };
static const double sample_step = 0.0005; /* SAMPLES of them are 0.1, SHORT 0.025, half a period */

typedef struct sample {
    double div_v,
        density; /* mean |div v| over particles and the time since the last sample; max |rho / rho0 - 1| at the time */
    double kinetic, total; /* energies; total: with those of the force, of the equation of state and of psi */
    double axis[2];        /* from the second moments */
} sample;

typedef struct history {
    sample at[SAMPLES + 1];
    int count;                   /* samples after the first */
    double div_v[2], density[2]; /* mean, largest: of all, of the second half */
    double momentum,
        turning; /* largest change of momentum and angular momentum, relative to sum m |v|, sum m |r| |v| of the start */
    double fastest;
} history;

static sample measure(const drop *d)
{
    static double start[2];
    sample s = {0};
    double moment[2] = {0, 0};
    int i, k;
    for (i = 0; i < d->n; i++) {
        const double e = d->a[RHO][i] / rho0, r2 = d->a[X][i] * d->a[X][i] + d->a[Y][i] * d->a[Y][i];
        const double kinetic = 0.5 * d->m * (d->a[VX][i] * d->a[VX][i] + d->a[VY][i] * d->a[VY][i]);
        s.kinetic += kinetic;
        /* the integral of P / rho^2 from rho0 to rho */
        s.total += kinetic + d->m * (0.5 * w * w * r2 + cs * cs / 7 * (pow(e, 6) / 6 + 1 / e - 7.0 / 6));
        if (d->cleans) s.total += 0.5 * d->m * pow(d->a[PSI][i] / (d->ch * d->a[RHO][i]), 2);
        s.density = fmax(s.density, fabs(e - 1));
        for (k = 0; k < 2; k++) moment[k] += d->a[X + k][i] * d->a[X + k][i];
    }
    if (!(start[0] > 0)) /* all runs start from the same disc */
        for (k = 0; k < 2; k++) start[k] = moment[k];
    for (k = 0; k < 2; k++) s.axis[k] = sqrt(moment[k] / start[k]);
    return s;
}
static void sums(const drop *d, double of[3])
{
    sph_conserved c;
    expect_all(sph_conserved_sums(2, cloud(d), sph_scalars_same(&d->m), vectors_of(d->a + VX, 2), &c));
    of[0] = c.momentum.x;
    of[1] = c.momentum.y;
    of[2] = c.angular_momentum.z;
}

/* Figure 7: the drop at a few times */
static const double snapshot[] = {0, 0.006, 0.012, 0.018, 0.024, 0.036};
enum { SNAPSHOTS = sizeof snapshot / sizeof *snapshot };

/* count samples of a drop; with courant 0.3 that is the paper's run. curves, shapes: lines for the figures, or null. */
static history integrate(drop *d, double courant, int count, FILE *curves, FILE *shapes, int quiet)
{
    const int per_sample = (int)ceil(sample_step / (courant * h / hypot(cs, d->ch)) - 1e-9);
    const double dt = sample_step / per_sample;
    double first[3], now[3], size = 0, turning = 0;
    char run[96];
    int k, step, i;
    progress p;
    history o = {0};
    snprintf(run, sizeof run, "drop, alpha %g, %s", d->alpha, d->cleans ? "cleaned" : "control");
    d->run = run;
    for (i = 0; i < d->n; i++) {
        const double v = hypot(d->a[VX][i], d->a[VY][i]);
        size += d->m * v;
        turning += d->m * v * hypot(d->a[X][i], d->a[Y][i]);
        o.fastest = fmax(o.fastest, v);
    }
    sums(d, first);
    o.count = count;
    o.at[0] = measure(d);
    progress_begin(&p, run, quiet);
    for (k = 0; k <= count; k++) {
        const double t = k * sample_step;
        double mean = 0, most = 0;
        for (step = 0; k > 0 && step < per_sample; step++) {
            d->t = t - sample_step + step * dt;
            advance(d, dt);
            for (i = 0; i < d->n; i++) {
                mean += fabs(d->a[DIVV][i]) / d->n / per_sample;
                most = fmax(most, fabs(d->a[RHO][i] / rho0 - 1));
            }
        }
        if (k > 0) {
            o.at[k] = measure(d);
            o.at[k].div_v = mean;
            for (i = 0; i < (2 * k > count ? 2 : 1); i++) {
                o.div_v[i] += mean / (i == 0 ? count : count - count / 2);
                o.density[i] = fmax(o.density[i], most);
            }
        }
        sums(d, now);
        o.momentum = fmax(o.momentum, hypot(now[0] - first[0], now[1] - first[1]) / size);
        o.turning = fmax(o.turning, fabs(now[2] - first[2]) / turning);
        for (i = 0; i < d->n; i++) o.fastest = fmax(o.fastest, hypot(d->a[VX][i], d->a[VY][i]));
        if (curves)
            fprintf(curves, "%g,%s,%.4f,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", d->alpha,
                    d->cleans ? "cleaned" : "control", t, o.at[k].div_v, o.at[k].density, o.at[k].kinetic,
                    o.at[k].total, o.at[k].axis[0], o.at[k].axis[1]);
        for (i = 0; shapes && i < SNAPSHOTS; i++)
            if (fabs(t - snapshot[i]) < 0.25 * sample_step) {
                int j;
                for (j = 0; j < d->n; j++)
                    fprintf(shapes, "%g,%s,%g,%.6g,%.6g,%.6g\n", d->alpha, d->cleans ? "cleaned" : "control",
                            t, d->a[X][j], d->a[Y][j], d->a[RHO][j] / rho0 - 1);
            }
        progress_update(&p, (k + 1.0) / (count + 1));
    }
    progress_end(&p);
    d->run = "a drop";
    return o;
}

/* The drop without compressibility at the samples: theta by Runge-Kutta's method. kinetic energy pi rho0 / 4 theta'^2 cosh 2 theta. */
static void exact(sample out[SAMPLES + 1])
{
    enum { PART = 200 };
    const double dt = sample_step / PART;
    double theta = 0, speed = w;
    int k, step, stage;
    for (k = 0; k <= SAMPLES; k++) {
        for (step = 0; k > 0 && step < PART; step++) {
            static const double share[] = {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0}, ahead[] = {0.5, 0.5, 1, 0};
            double th = theta, sp = speed, sum_th = 0, sum_sp = 0;
            for (stage = 0; stage < 4; stage++) {
                const double d_th = sp, d_sp = -(sp * sp + w * w) * tanh(2 * th);
                sum_th += share[stage] * d_th;
                sum_sp += share[stage] * d_sp;
                th = theta + ahead[stage] * dt * d_th;
                sp = speed + ahead[stage] * dt * d_sp;
            }
            theta += dt * sum_th;
            speed += dt * sum_sp;
        }
        out[k].div_v = out[k].density = 0;
        out[k].kinetic = 0.25 * MATH_PI * rho0 * speed * speed * cosh(2 * theta);
        out[k].total = 0.25 * MATH_PI * rho0 * (speed * speed + w * w) * cosh(2 * theta);
        out[k].axis[0] = exp(-theta);
        out[k].axis[1] = exp(theta);
    }
}

/* Largest differences to time number `last` of samples: of the axes, of the kinetic energy in units of the first */
static double axis_error(const history *o, const sample *of, int last)
{
    double most = 0;
    int k, a;
    for (k = 0; k <= last; k++)
        for (a = 0; a < 2; a++) most = fmax(most, fabs(o->at[k].axis[a] - of[k].axis[a]));
    return most;
}
static double kinetic_difference(const sample *one, const sample *other, int last)
{
    double most = 0;
    int k;
    for (k = 0; k <= last; k++) most = fmax(most, fabs(one[k].kinetic - other[k].kinetic) / other[0].kinetic);
    return most;
}
static double energy_change(const history *o)
{
    return (o->at[o->count].total - o->at[0].total) / o->at[0].total;
}

/* ---------------------------------------------------------------- what is reported */

enum { CONTROL, CLEANED };
static const char *const run_name[] = {"control", "cleaned"};

/* The sums of section III-C with the fields of a drop in motion: psi in the place of p, no viscosity, no damping */
static void identities(report *r, drop *d)
{
    double v_dv = 0, psi_dpsi = 0, size = 0, own = 0, p[2] = {0, 0}, L = 0, force = 0;
    const sph_cleaning_wave undamped = {.ch = d->ch, .h = h};
    char text[128];
    int i;
    report_section(r,
                   "Section III: the sums of velocity cleaning, in the drop at the end of the cleaned run");
    neighbours(d);
    divergence(d);
    for (i = 0; i < d->n; i++) d->a[P][i] = d->a[PSI][i];
    accelerate(d, SPH_VISCOSITY_NONE);
    for (i = 0; i < d->n; i++) {
        const double rho = d->a[RHO][i], rate = -rho * d->a[DIVV][i],
                     dpsi = sph_cleaning_rate_velocity(undamped, 0, rate);
        const double per = d->m * d->a[PSI][i] / (d->ch * d->ch * rho * rho);
        v_dv += d->m * (d->a[VX][i] * d->a[AX][i] + d->a[VY][i] * d->a[AY][i]);
        psi_dpsi += per * dpsi;
        size += d->m * (fabs(d->a[VX][i] * d->a[AX][i]) + fabs(d->a[VY][i] * d->a[AY][i])) + fabs(per * dpsi);
        own += per * d->a[PSI][i] * rate / rho;
        p[0] += d->m * d->a[AX][i];
        p[1] += d->m * d->a[AY][i];
        L += d->m * (d->a[X][i] * d->a[AY][i] - d->a[Y][i] * d->a[AX][i]);
        force += d->m * hypot(d->a[AX][i], d->a[AY][i]);
    }
    report_absolute(report_beside(r, REPORT_THEORY), "(37), (39)", "rho frozen, undamped",
                    "rate of sum m (v^2/2 + psi^2/(2 ch^2 rho^2)), relative", 0, (v_dv + psi_dpsi) / size,
                    1e-13);
    report_absolute(report_beside(r, REPORT_THEORY), "(39)", "psi", "rate of momentum, relative", 0, hypot(p[0], p[1]) / force, 1e-13);
    report_absolute(report_beside(r, REPORT_THEORY), "(39)", "psi", "rate of angular momentum, relative", 0, L / force, 1e-13);
    snprintf(text, sizeof text, "left side / printed right side = %.12f", v_dv / psi_dpsi);
    report_claim_fails(r, "(38)", "the sums", "sign of the right side", "+", text,
                       "-: the time derivative of (37) is 0, and (39) follows from that");
    report_info(r, "(30) to (35)", "rho as it evolves",
                "rate of the energy that is left over / rate of that of psi", -own / psi_dpsi);

    /* (28): v = x, so that the drop grows */
    for (i = 0; i < d->n; i++) {
        d->a[VX][i] = d->a[X][i];
        d->a[VY][i] = d->a[Y][i];
    }
    divergence(d);
    {
        double mean = 0;
        for (i = 0; i < d->n; i++) mean -= d->a[DIVV][i] / d->n;
        snprintf(text, sizeof text, "mean of + sum m v_ij . grad W / rho = %.3f for v = x; as printed + %.3f",
                 mean, -mean);
        report_claim_fails(r, "(28)", "v = x", "sign", "-", text,
                           "+: a drop that grows gets thinner (-2 in its middle), and (36) has that sign");
    }
    {
        double inside = 0, volume = 0;
        for (i = 0; i < d->n; i++) {
            volume += d->m / d->a[RHO][i];
            inside += d->m / d->a[RHO][i] * d->a[DIVV][i];
        }
        /* psi = 1: - int v . grad psi is 0; the surface integral is twice the area */
        snprintf(text, sizeof text,
                 "int psi div v = %.2f, surface %.2f: their difference should be 0, not their sum", inside,
                 2 * volume);
        report_claim_fails(r, "(33)", "psi = 1, v = x", "sign of the surface integral", "+", text,
                           "-: by parts; what is left of the difference is the rim's");
    }
}

/* What the steps add to the energy of a drop without viscosity and cleaning, up to t = 0.02; control: one with dt = 0.3 h / cs */
static void steps(report *r, const history *control, int quiet)
{
    enum { COUNT = 40 };
    drop d = drop_new(0, SPH_VISCOSITY_NONE, 0);
    const history half = integrate(&d, 0.15, COUNT, NULL, NULL, quiet);
    double change[2] = {0, 0};
    int k;
    drop_close(&d);
    for (k = 0; k <= COUNT; k++) {
        change[0] = fmax(change[0], fabs(control->at[k].total / control->at[0].total - 1));
        change[1] = fmax(change[1], fabs(half.at[k].total / half.at[0].total - 1));
    }
    report_section(r, "Steps: the energy of the control without viscosity, t <= 0.02");
    cleaning_trial(r, "steps", "dt = 0.3 h / cs", "largest change of the energy, relative", 2.06e-5,
                   change[0], 1.5);
    cleaning_trial(r, "steps", "dt = 0.15 h / cs", "largest change of the energy, relative", 5.25e-6,
                   change[1], 1.5);
    report_range(r, "steps", "half of the step", "ratio of the changes", (double)NAN, change[0] / change[1],
                 3.5, 4.5);
}

/* Values of the independent trial, to t = 0.1: control and cleaned */
typedef struct trial {
    double alpha;
    double div_v[2], density[2], axis[2], energy[2];
} trial;
static const trial trials[] = {{0.01, {23.6, 2.62}, {3.0e-2, 1.8e-2}, {0.129, 0.120}, {-8.9e-2, -8.8e-2}},
                               {0, {132, 4.6}, {9.1e-2, 1.9e-2}, {0.153, 0.120}, {-1.7e-4, -8.7e-2}},
                               {0.1, {2.58, 0.907}, {2.3e-2, 1.6e-2}, {0.194, 0.185}, {-0.146, -0.142}}};

static const char *text_of(const char *format, double a)
{
    static char text[4][96];
    static int turn;
    turn = (turn + 1) % 4;
    snprintf(text[turn], sizeof text[turn], format, a);
    return text[turn];
}

/* What was measured in one run, and the trial's values where it ran as long */
static void one_run(report *r, const trial *t, int which, const history *o, const sample *ode)
{
    const double end = o->count * sample_step;
    const int whole = o->count == SAMPLES;
    char at[96];
    snprintf(at, sizeof at, "alpha = %g, %s, to t = %g%s", t->alpha, run_name[which], end,
             whole ? "" : " (-full: 0.1)");
    if (whole) {
        cleaning_trial(r, "Figure 8", at, "mean of mean |div v|", t->div_v[which], o->div_v[0], 1.5);
        cleaning_trial(r, "Figure 9", at, "max |rho / rho0 - 1|", t->density[which], o->density[0], 1.5);
        cleaning_trial(r, "Figure 7", at, "largest difference of an axis from the ellipse's", t->axis[which],
                       axis_error(o, ode, o->count), 1.5);
        cleaning_trial(r, "Figure 10", at, "relative loss of energy", -t->energy[which], -energy_change(o),
                       1.5);
    } else {
        report_info(r, "Figure 8", at, "mean of mean |div v|", o->div_v[0]);
        report_info(r, "Figure 9", at, "max |rho / rho0 - 1|", o->density[0]);
        report_info(r, "Figure 7", at, "largest difference of an axis from the ellipse's",
                    axis_error(o, ode, o->count));
        report_info(r, "Figure 10", at, "relative loss of energy", -energy_change(o));
    }
    report_info(r, "Figure 8", at, "mean of mean |div v|, second half", o->div_v[1]);
    report_info(r, "Figure 9", at, "max |rho / rho0 - 1|, second half", o->density[1]);
    report_absolute(report_beside(r, REPORT_THEORY), "III-C", at, "change of momentum, relative", 0, o->momentum, 1e-12);
    report_absolute(report_beside(r, REPORT_THEORY), "III-C", at, "change of angular momentum, relative", 0, o->turning, 1e-12);
}

static void ellipse(report *r, const sample *ode)
{
    double top = 0, period = 0;
    int k;
    report_section(r, "The ellipse");
    for (k = 0; k <= SAMPLES; k++) {
        top = fmax(top, ode[k].axis[1]);
        /* theta' > 0 and theta passes 0: the end of a period */
        if (k > 20 && !(period > 0) && ode[k - 1].axis[1] < 1 && ode[k].axis[1] >= 1)
            period = sample_step * (k - (ode[k].axis[1] - 1) / (ode[k].axis[1] - ode[k - 1].axis[1]));
    }
    report_absolute(report_beside(r, REPORT_THEORY), "ellipse", "theta'' = -(theta'^2 + w^2) tanh 2 theta",
                    "longest axis, sampled (exact: sqrt(2 + sqrt 3))", sqrt(2 + sqrt(3.0)), top, 1e-3);
    report_range(r, "IV-D", "until t = 0.1", "periods ('approximately two')", 2, 0.1 / period, 1.9, 2.1);
    report_absolute(report_beside(r, REPORT_THEORY), "ellipse", "the same", "largest change of its energy, relative", 0,
                    fabs(ode[SAMPLES].total / ode[0].total - 1), 1e-10);
}

/* The paper's statements beside the pair of runs that comes nearest to its figures, alpha = 0.01 */
static void in_words(report *r, const history *o, const sample *ode)
{
    const double div_v = o[CONTROL].div_v[0] / o[CLEANED].div_v[0],
                 density = o[CONTROL].density[0] / o[CLEANED].density[0];
    double top[2] = {0, 0};
    char text[128];
    int k, half, which;
    for (half = 1; half < SAMPLES && !(ode[half].axis[1] < 1); half++) continue; /* T/2: the disc again */
    report_section(r, "Section IV-D in words, alpha = 0.01");
    snprintf(text, sizeof text, "%.1f times less", div_v);
    report_claim(r, "Figure 8", "alpha = 0.01", "average div v", "reduced by nearly an order of magnitude",
                 text, "within sqrt(10) of 10", fabs(log10(div_v) - 1) <= 0.5);
    report_range(r, "Figure 8", "alpha = 0.01", "mean |div v|, control / cleaned", 10, div_v, 6, HUGE_VAL);
    snprintf(text, sizeof text, "%.2f times less", density);
    report_claim(r, "Figure 9", "alpha = 0.01", "maximum density error", "reduced by a factor of two", text,
                 "within sqrt(2) of 2", density >= sqrt(2.0) && density <= 2 * sqrt(2.0));
    report_range(r, "Figure 9", "alpha = 0.01", "max |rho / rho0 - 1|, control / cleaned", 2, density, 1.4,
                 HUGE_VAL);
    snprintf(text, sizeof text, "%.2f %% of the first at most",
             100 * kinetic_difference(o[CLEANED].at, o[CONTROL].at, SAMPLES));
    report_claim(r, "Figure 10", "alpha = 0.01", "kinetic energy, control and cleaned",
                 "no significant discrepancies", text, "< 5 % of the first",
                 kinetic_difference(o[CLEANED].at, o[CONTROL].at, SAMPLES) < 0.05);
    report_range(r, "Figure 10", "alpha = 0.01, t = 0.1", "|difference of the total energies| / first", (double)NAN,
                 fabs(energy_change(&o[CLEANED]) - energy_change(&o[CONTROL])), 0, 0.02);
    for (which = CONTROL; which <= CLEANED; which++) {
        for (k = 0; k <= half; k++) top[which] = fmax(top[which], o[which].at[k].axis[1]);
        report_relative(report_beside(r, REPORT_THEORY), "Figure 7", text_of(which ? "cleaned, alpha = %g" : "control, alpha = %g", 0.01),
                        "first longest axis beside the ellipse's", sqrt(2 + sqrt(3.0)), top[which], 0.03);
        report_range(
            report_beside(r, REPORT_THEORY), "Figure 10",
            text_of(which ? "cleaned, to half a period, alpha = %g" : "control, to half a period, alpha = %g",
                    0.01),
            "kinetic energy - ellipse's, of the first", 0, kinetic_difference(o[which].at, ode, half), 0,
            0.1);
    }
    report_info(r, "III-A", "control, alpha = 0.01", "cs / largest speed ('10 at least')",
                cs / o[CONTROL].fastest);
}

/* What depends on the viscosity, which the paper does not name */
static void depends(report *r, double alpha, const history *o)
{
    const int last = o[CONTROL].count;
    const double end = last * sample_step;
    char at[96], text[128];
    snprintf(at, sizeof at, "alpha = %g, to t = %g", alpha, end);
    report_info(r, "Figure 8", at, "mean |div v|, control / cleaned",
                o[CONTROL].div_v[0] / o[CLEANED].div_v[0]);
    report_info(r, "Figure 9", at, "max |rho / rho0 - 1|, control / cleaned",
                o[CONTROL].density[0] / o[CLEANED].density[0]);
    report_info(r, "Figure 10", at, "largest difference of the kinetic energies, of the first",
                kinetic_difference(o[CLEANED].at, o[CONTROL].at, last));
    if (alpha > 0) return;
    report_range(report_beside(r, REPORT_THEORY), "Figure 10", at, "control: |change of the energy| / first", 0,
                 fabs(energy_change(&o[CONTROL])), 0, 1e-3);
    snprintf(text, sizeof text, "the control loses %.3f %% of its energy, the cleaned drop %.1f %%",
             -100 * energy_change(&o[CONTROL]), -100 * energy_change(&o[CLEANED]));
    report_claim_fails(r, "IV-D", at, "dissipation by cleaning", "'insignificant'", text,
                       "so it is beside a control with viscosity only, which loses as much");
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0, quiet = 0;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "all runs to t = 0.1, and the viscosity of 1992", OPTION_FLAG, &full, 0, 0},
        {"quiet", "no line of progress", OPTION_FLAG, &quiet, 0, 0},
    };
    static report r;
    static history o[2];
    static sample ode[SAMPLES + 1];
    FILE *curves, *shapes;
    int k, which;
    options_parse(argc, argv,
                  "The oscillating drop of the paper on divergence cleaning (figures 7 to 10): published "
                  "against measured.",
                  specs, 4);
    report_open(&r, "cleaning_drop", out);
    figure_folder(figures, "cleaning_drop");
    curves = figure_open(figures, "cleaning_fig8");
    shapes = figure_open(figures, "cleaning_fig7");
    fprintf(curves, "alpha,run,t,mean_div_v,max_density_error,kinetic,total,axis_x,axis_y\n");
    fprintf(shapes, "alpha,run,t,x,y,density_error\n");
    exact(ode);
    for (k = 0; k <= SAMPLES; k++)
        fprintf(curves, "0,ellipse,%.4f,0,0,%.9g,%.9g,%.9g,%.9g\n", k * sample_step, ode[k].kinetic,
                ode[k].total, ode[k].axis[0], ode[k].axis[1]);
    ellipse(&r, ode);
    for (k = 0; k < (int)(sizeof trials / sizeof *trials); k++) {
        const trial *const t = &trials[k];
        for (which = CONTROL; which <= CLEANED; which++) {
            drop d = drop_new(t->alpha, SPH_VISCOSITY_SIGNAL, which);
            o[which] =
                integrate(&d, 0.3, full || k == 0 ? SAMPLES : SHORT, curves, k == 0 ? shapes : NULL, quiet);
            if (k == 0 && which == CLEANED) identities(&r, &d);
            drop_close(&d);
        }
        report_section(&r, text_of("Figures 7 to 10, viscosity alpha = %g", t->alpha));
        for (which = CONTROL; which <= CLEANED; which++) one_run(&r, t, which, &o[which], ode);
        depends(&r, t->alpha, o);
        if (k == 0) in_words(&r, o, ode);
        if (!(t->alpha > 0)) steps(&r, &o[CONTROL], quiet);
    }
    if (full) {
        report_section(&r, "Another viscosity: Monaghan 1992, alpha = 0.01, beta = 0.02");
        for (which = CONTROL; which <= CLEANED; which++) {
            drop d = drop_new(0.01, SPH_VISCOSITY_MONAGHAN, which);
            o[which] = integrate(&d, 0.3, SAMPLES, NULL, NULL, quiet);
            drop_close(&d);
        }
        depends(&r, 0.01, o);
    }
    figure_close(curves);
    figure_close(shapes);
    return report_close(&r) ? 1 : 0;
}
