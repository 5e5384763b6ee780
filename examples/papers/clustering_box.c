/* SPDX-License-Identifier: MIT
 *
 * clustering_box.c - section V.I of the paper on particle clustering: a periodic box of gas whose particles start at random; figures 1, 2, 3.
 *
 *     cc -O2 -o clustering_box examples/papers/clustering_box.c -lm
 *     clustering_box -out DIR -figures DIR [-full]       (-h for help)
 *
 * 1 x 1 box, 462 particles (a hexagonal lattice of dref = 1/20 has 461.9), rho0 = 1, c = 10, h = 2 dref, alpha = 0.1, to t = 2; collisions with delta_c = 0.85, C_R = 0.01. The paper does not give p0:
 * all runs are made with p0 = 0 and with p0 = rho0 c^2, and what it says is judged for both.
 * Steps of 1e-4, the paper's, with -full; 5e-4 without, and 1e-3 in two studies (the limit of sound is 2.5e-3).
 */
#define FLOW_FORM(f) FLOW_SUMMATION
#include "clustering.h"

enum { PARTICLES = 462, BINS = 80 };

/* ================================================================ a run */

typedef struct setting {
    sph_kernel kernel;
    double smoothing; /* h / dref */
    double p0;
    int remedy;
    double distance, restitution;
    double artificial; /* Monaghan's artificial pressure: 0.01 as he has it for positive pressures, 0 off */
    int seed, coincident;
    double dt, tend;
    const char *figure; /* name of the snapshot, or null */
} setting;

typedef struct result {
    flow_answer answer;
    flow_distribution d;
    sph_conserved sums;
    double peak_at, peak, noise; /* of g(r); noise: standard deviation of the density / mean */
    double worst_gain, t, microseconds;
    int64_t collisions;
    sph_index coincident; /* particles that coincide with another at the end */
} result;

static setting usual(sph_kernel kernel, double p0, int remedy, double dt)
{
    setting s = {SPH_WENDLAND_C2_1D, 2, 0, FLOW_NO_COLLISIONS, 0.85, 0.01, 0, 1, 0, 0, 2, NULL};
    s.kernel = kernel;
    s.p0 = p0;
    s.remedy = remedy;
    s.dt = dt;
    return s;
}

/* Monaghan 2000, JCP 159, 290: R f^4 joins the pressure term, f = W(r) / W(dref); R = 0.01 (p_i / rho_i^2 + p_j / rho_j^2) where both pressures are positive, and 0.2 |p| / rho^2 of each that is not. */
static double repulsion(double p_i, double rho_i, double p_j, double rho_j, double share)
{
    const sph_fluid_side i = {.p = p_i, .rho = rho_i}, j = {.p = p_j, .rho = rho_j};
    if (p_i > 0 && p_j > 0) return share * sph_pressure_pair_monaghan(i, j);
    return 20 * share * ((p_i < 0 ? -p_i / (rho_i * rho_i) : 0) + (p_j < 0 ? -p_j / (rho_j * rho_j) : 0));
}
static void add_repulsion(flow *f)
{
    const double share = *(const double *)f->data, lattice = sph_kernel_w(f->kernel, 2, f->dref, f->h);
    sph_index i, p;
    for (i = 0; i < f->n_fluid; i++)
        for (p = f->all.start[i]; p < f->all.start[i + 1]; p++) {
            const sph_index j = f->all.index[p];
            const sph_vec x_ij = sphi_separation(2, flow_points(f), sphi_point(2, flow_points(f), i),
                                                 sphi_point(2, flow_points(f), j));
            const double r = sph_length(2, x_ij), near_to = sph_kernel_w(f->kernel, 2, r, f->h) / lattice,
                         square = near_to * near_to;
            const double b = f->m[j] * repulsion(f->p[i], f->rho[i], f->p[j], f->rho[j], share) * square *
                             square * sph_kernel_f(f->kernel, 2, r, f->h);
            f->ax[i] -= b * x_ij.x;
            f->ay[i] -= b * x_ij.y;
        }
}

static result simulate(const setting *s, const clustering_options *o, const char *name)
{
    const flow_domain box = {0, 1, 0, 1};
    const double dref = clustering_choose(o->dref, 1.0 / 20);
    const int n = o->dref > 0 ? (int)(1 / (hexagonal * dref * dref) + 0.5) : PARTICLES;
    double g[BINS], share = s->artificial, mean = 0, square = 0;
    result r;
    pcg32 random;
    flow f;
    int i;
    memset(&r, 0, sizeof r);
    flow_open(&f, name, s->kernel, dref, s->smoothing * dref);
    f.box_x = f.box_y = 1;
    f.dt = s->dt;
    f.state[0].rho0 = 1;
    f.state[0].c = 10;
    f.state[0].p0 = s->p0;
    f.remedy = s->remedy;
    f.distance = s->distance;
    f.restitution = s->restitution;
    f.quiet = o->quiet;
    f.vtk = o->vtk ? o->out : NULL;
    if (share > 0) {
        f.force = add_repulsion;
        f.data = &share;
    }
    pcg32_seed(&random, (uint64_t)s->seed, 1);
    for (i = 0; i < n; i++) {
        const double x = pcg32_uniform(&random), y = pcg32_uniform(&random);
        flow_add(&f, x, y, 0, 1.0 / n);
    }
    for (i = 0; i < s->coincident; i++) { /* pairs at one point */
        f.x[2 * i + 1] = f.x[2 * i];
        f.y[2 * i + 1] = f.y[2 * i];
    }
    if (s->tend > 0) r.answer = flow_run(&f, s->tend);
    if (r.answer == FLOW_INTERRUPTED) flow_require(&f, r.answer);
    if (r.answer == FLOW_DONE || s->remedy == FLOW_LITERAL) { /* what the literal form does is a result */
        r.d = flow_measure(&f, FLOW_ALL, 0, box, NULL);
        flow_conserved(&f, &r.sums);
        flow_radial(&f, 1, 4, BINS, g, &r.peak_at, &r.peak);
        if (s->figure) flow_snapshot(&f, o->figures, s->figure);
    } else flow_require(&f, r.answer);
    for (i = 0; i < n; i++) mean += f.rho[i] / n;
    for (i = 0; i < n; i++) square += (f.rho[i] - mean) * (f.rho[i] - mean) / n;
    r.noise = sqrt(square) / mean;
    if (f.all.start) r.coincident = sph_coincident_count(2, flow_cloud(&f), 1e-12 * f.h);
    r.worst_gain = f.worst_gain;
    r.t = f.t;
    r.collisions = f.collisions;
    r.microseconds = flow_microseconds(&f);
    flow_close(&f);
    return r;
}

/* ================================================================ rows */

static const char *describe(const setting *s)
{
    static char text[128];
    static const char *const remedy[FLOW_REMEDIES] = {"", ", collisions", ", collisions weighted",
                                                      ", (4.20) as printed"};
    snprintf(text, sizeof text, "%s, p0 = %g%s%s", sph_kernel_name(s->kernel), s->p0,
             s->artificial > 0 ? ", artificial pressure" : "", remedy[s->remedy]);
    return text;
}
static void row_info(report *r, const char *item, const setting *s, const char *more, const result *a)
{
    char at[192], text[160];
    snprintf(at, sizeof at, "%s%s", describe(s), more);
    snprintf(text, sizeof text, "%.3f (%.3f), %.3f, %.3f; %.3f; %.4f; %.1f @ %.2f", a->d.mean, a->d.least,
             a->d.below_50, a->d.below_75, a->d.hexatic, a->d.void_share, a->peak, a->peak_at);
    report_row(r, item, at, "nnd mean (least), f(<.5), f(<.75); psi6; void; g peak @ r", NULL, text, NULL,
               NULL, REPORT_INFO);
}
static void momentum_row(report *r, const char *at, const result *a)
{
    report_absolute(report_beside(r, REPORT_THEORY), "V.I", at, "momentum (the masses sum to 1)", 0,
                    fmax(fabs(a->sums.momentum.x), fabs(a->sums.momentum.y)), 1e-13);
}

/* ================================================================ figures 1 and 3 */

enum { METHODS = 3, PRESSURES = 2 };
static const double background[PRESSURES] = {0, 100};

/* What a run gives is a draw: rounding alone changes it. Bounds of single runs are four standard deviations from the mean of 24 seeds of our own, (1.1) with p0 = rho0 c^2: mean nearest distance 0.604 +- 0.018,
   f(<.5) = 0.264 +- 0.045 (lattice: 1 and 0; random: 0.47 and 0.6). p0 = 0 gives 0.587 +- 0.012 and 0.29 +- 0.04. */
static const double clustered_mean = 0.676, clustered_share = 0.084;

static void paper_runs(report *r, const clustering_options *o, int seeds, double dt)
{
    static const char *const figure[METHODS] = {"untreated", "convex", "collisions"};
    static const char *const item[METHODS] = {"Figure 1", "Figure 3 left", "Figure 3 right"};
    double highest[PRESSURES][METHODS] = {{0}}, lowest[PRESSURES][METHODS], share[PRESSURES] = {0},
           cost = 0; /* of psi6; mean f(<.5), untreated */
    char text[160];
    int p, a, seed, runs = 0;
    setting start = usual(SPH_WENDLAND_C2_1D, 0, FLOW_NO_COLLISIONS, dt);
    result initial;
    start.tend = 0;
    start.figure = "clustering_box_initial";
    initial = simulate(&start, o, "box");
    report_section(r, "Figures 1 and 3: distances in units of dref, f: share of particles nearer than that "
                      "to their nearest");
    row_info(r, "Figure 1", &start, ", initial", &initial);
    for (p = 0; p < PRESSURES; p++)
        for (seed = 1; seed <= seeds; seed++)
            for (a = 0; a < METHODS; a++) {
                setting s = usual(a == 1 ? SPH_CONVEX : SPH_WENDLAND_C2_1D, background[p],
                                  a == 2 ? FLOW_SEQUENTIAL : FLOW_NO_COLLISIONS, dt);
                char at[160], name[48], run[80];
                result x;
                s.seed = seed;
                if (a == 2)
                    s.dt = fmin(dt, 2e-4); /* pairs come closer than delta_c by what they move in a step */
                snprintf(name, sizeof name, "clustering_box_%s_%s", figure[a], p ? "p0" : "0");
                if (seed == 1) s.figure = name;
                snprintf(run, sizeof run, "%s_seed%d", name, seed);
                x = simulate(&s, o, run);
                snprintf(at, sizeof at, "%s, seed %d", describe(&s), seed);
                row_info(r, item[a], &s, "", &x);
                if (a == 0) {
                    report_range(r, item[a], at, "mean nearest distance (no lattice)", (double)NAN, x.d.mean,
                                 0, clustered_mean);
                    report_range(r, item[a], at, "f(<.5) (clusters)", (double)NAN, x.d.below_50,
                                 clustered_share, 1);
                } else if (a == 1) {
                    report_range(r, item[a], at, "mean nearest distance", (double)NAN, x.d.mean, 0.82, 1.1);
                    report_range(r, item[a], at, "f(<.5)", (double)NAN, x.d.below_50, 0, 0);
                } else
                    report_range(r, item[a], at, "least nearest distance", (double)NAN, x.d.least, 0.84, 1.1);
                momentum_row(r, at, &x);
                highest[p][a] = fmax(highest[p][a], x.d.hexatic);
                lowest[p][a] = seed == 1 ? x.d.hexatic : fmin(lowest[p][a], x.d.hexatic);
                if (a == 0) share[p] += x.d.below_50 / seeds;
                cost += x.microseconds;
                runs++;
            }
    for (p = 0; p < PRESSURES && seeds > 1; p++)
        report_range(r, "Figure 1",
                     p ? "(1.1), p0 = rho0 c^2, mean of the seeds" : "(1.1), p0 = 0, mean of the seeds",
                     "f(<.5) (clusters)", (double)NAN, share[p], 0.2, 1);
    snprintf(text, sizeof text,
             "psi6 at most %.2f, %.2f, %.2f (untreated, convex, collisions); 1: lattice, .36: random",
             highest[0][0], highest[0][1], highest[0][2]);
    report_claim_known(r, "V.I", "p0 = 0", "'an almost hexagonal distribution'", "Figure 3", text, "psi6 > .8",
                       highest[0][1] > 0.8 || highest[0][2] > 0.8, 0,
                       "it takes a background pressure, which the paper does not mention");
    snprintf(text, sizeof text,
             "psi6 of convex at least %.2f; of collisions %.2f to %.2f (12 seeds: .57 to .84)", lowest[1][1],
             lowest[1][2], highest[1][2]);
    report_claim(r, "V.I", "p0 = rho0 c^2", "'an almost hexagonal distribution'", "Figure 3 (judged: convex)",
                 text, "psi6 > .8", lowest[1][1] > 0.8);
    report_info(r, "run", "", "CPU microseconds per particle and step", cost / runs);
}

/* ================================================================ what is said in words */

/* 'With Wendland kernels, too' is said of (1.1), whose Fourier transform is positive in one dimension only. */
static void rebuttal(report *r, const clustering_options *o, int full, double dt)
{
    int p;
    report_section(r, "Section I: 'also with Wendland kernels particle clustering can occur'");
    for (p = full ? 0 : 1; p < PRESSURES; p++) {
        const setting s = usual(SPH_WENDLAND_C2, background[p], FLOW_NO_COLLISIONS, dt);
        const result x = simulate(&s, o, "box_wendland-c2");
        char text[128];
        row_info(r, "Section I", &s, "", &x);
        if (p == 0) continue;
        snprintf(text, sizeof text,
                 "the Wendland C2 of two dimensions: mean %.3f, f(<.5) = %.3f, psi6 = %.2f", x.d.mean,
                 x.d.below_50, x.d.hexatic);
        report_claim_known(r, "Section I", describe(&s), "Wendland kernels", "cluster, against [3]", text,
                           "f(<.5) > 0, or a mean below .82", x.d.mean <= 0.82 || x.d.below_50 > 0, 0,
                           "(1.1) belongs to one dimension: [3] does not speak of it in two");
    }
}

/* '... it is impossible to reconstruct linear functions on a uniform grid' (Fulk & Quinn): what the sum sum_j V_j f_j W_ij, and the gradient, make of a linear f there */
static void linear_functions(report *r)
{
    static const struct {
        sph_kernel k;
        double h, S, G; /* known from an independent sum */
    } lattice[] = {{SPH_WENDLAND_C2_1D, 1.5, 0.00033, -0.00761}, {SPH_WENDLAND_C2_1D, 2, -0.00003, 0.00061},
                   {SPH_CONVEX, 1.5, 0.03201, -0.02146},         {SPH_CONVEX, 2, 0.01343, -0.00628},
                   {SPH_HERMITE, 1.5, -0.00231, 0.00487},        {SPH_WENDLAND_C2, 1.5, 0.00368, -0.00803}};
    double S, G, smooth = 0, convex = 0;
    char text[160];
    int a;
    report_section(r, "Section III: linear functions on a uniform (hexagonal) grid");
    for (a = 0; a < 6; a++) {
        char at[64];
        clustering_lattice(lattice[a].k, lattice[a].h, &S, &G);
        snprintf(at, sizeof at, "%s, h = %g dref", sph_kernel_name(lattice[a].k), lattice[a].h);
        report_absolute(report_beside(r, REPORT_REGRESSION), "Section III", at, "sum V W - 1, of an independent sum", lattice[a].S,
                        S - 1, 6e-6);
        report_absolute(report_beside(r, REPORT_REGRESSION), "Section III", at, "gradient factor - 1, of an independent sum", lattice[a].G, G - 1, 6e-6);
    }
    /* by symmetry, sum V f W = S f for a linear f */
    clustering_lattice(SPH_WENDLAND_C2_1D, 2, &smooth, &G);
    clustering_lattice(SPH_CONVEX, 2, &convex, &G);
    snprintf(
        text, sizeof text,
        "f = x comes back as %.4f x by (3.9), %.5f x by (1.1), at h = 2 dref; divided by sum V W: exactly",
        convex, smooth);
    report_claim(r, "Section III", "f = x, hexagonal grid", "'impossible to reconstruct linear functions'",
                 "with convex kernels", text, "holds for the plain sum: above 1 %", convex - 1 > 0.01);
}

static void larger_smoothing(report *r, const clustering_options *o, int full, double dt)
{
    static const double ratio[] = {3, 1.5, 2, 2.5};
    int a;
    report_section(r, "Section III: 'the higher sensitivity can be reduced by choosing a larger smoothing "
                      "scale', without clustering");
    for (a = 0; a < (full ? 4 : 1); a++) {
        setting s = usual(SPH_CONVEX, 100, FLOW_NO_COLLISIONS, dt);
        char more[48], text[128];
        result x;
        s.smoothing = ratio[a];
        x = simulate(&s, o, "box_larger_h");
        snprintf(more, sizeof more, ", h = %g dref", ratio[a]);
        row_info(r, "Section III", &s, more, &x);
        snprintf(text, sizeof text, "mean %.3f, f(<.5) = %.3f; density varies by %.2g", x.d.mean,
                 x.d.below_50, x.noise);
        report_claim(r, "Section III", more + 2, "convex kernel, larger h", "does not lead to clustering",
                     text, "mean > .82, f(<.5) = 0", x.d.mean > 0.82 && x.d.below_50 <= 0);
    }
}

/* (4.20) as printed, and as a host may use it */
static void literal(report *r, const clustering_options *o, double dt)
{
    int p;
    report_section(r, "Section IV: (4.20) as printed, and with approaching pairs only");
    for (p = 0; p < PRESSURES; p++) {
        const setting s = usual(SPH_WENDLAND_C2_1D, background[p], FLOW_LITERAL, dt);
        const result x = simulate(&s, o, "box_literal");
        char text[160];
        snprintf(
            text, sizeof text,
            "%s t = %.2f: mean %.3f, f(<.5) = %.3f, kinetic energy %.3g; largest gain in a step %.2g times",
            x.answer == FLOW_BLEW_UP ? "blew up at" : "ran to", x.t, x.d.mean, x.d.below_50,
            x.sums.kinetic_energy, 1 + x.worst_gain);
        report_claim_fails(r, "(4.20)", describe(&s), "the sum over all pairs in reach", "Figure 3 right",
                           text, "pairs that part are pulled back: it takes 'approaching' in C_i");
    }
    for (p = 0; p < PRESSURES; p++) {
        const setting s = usual(SPH_WENDLAND_C2_1D, background[p], FLOW_WEIGHTED, dt);
        const result x = simulate(&s, o, "box_weighted");
        row_info(r, "weighted", &s, "", &x);
        report_range(r, "weighted", describe(&s), "largest gain of energy by the collisions of a step",
                     (double)NAN, x.worst_gain, -1, 1e-12);
    }
}

static void restitution_study(report *r, const clustering_options *o, double dt)
{
    static const double restitution[] = {0, 0.01, 0.5, 1}, distance[] = {0.75, 0.85, 0.95};
    int a;
    report_section(r, "beyond the paper: C_R and delta_c, (1.1), p0 = rho0 c^2");
    for (a = 0; a < 7; a++) {
        setting s = usual(SPH_WENDLAND_C2_1D, 100, FLOW_SEQUENTIAL, dt);
        char more[64];
        result x;
        if (a < 4) s.restitution = restitution[a];
        else s.distance = distance[a - 4];
        x = simulate(&s, o, "box_restitution");
        snprintf(more, sizeof more, ", C_R = %g, delta_c = %g", s.restitution, s.distance);
        row_info(r, "beyond", &s, more, &x);
        report_info(r, "beyond", more + 2, "kinetic energy at the end", x.sums.kinetic_energy);
    }
}

/* Monaghan's artificial pressure, Read's kernel, kernels with positive transforms, other convex kernels */
static void rivals(report *r, const clustering_options *o, double dt)
{
    static const sph_kernel kernel[] = {SPH_HERMITE, SPH_CUBIC_SPLINE, SPH_CORE_TRIANGLE, SPH_JOHNSON_BEISSEL,
                                        SPH_SCHUESSLER_SCHMITT};
    int p, a;
    report_section(r, "beyond the paper: rivals");
    for (p = 0; p < PRESSURES; p++) {
        setting s = usual(SPH_WENDLAND_C2_1D, background[p], FLOW_NO_COLLISIONS, dt);
        result x;
        s.artificial = 0.01;
        x = simulate(&s, o, "box_artificial");
        row_info(r, "Monaghan 2000", &s, "", &x);
        for (a = 0; a < (int)(sizeof kernel / sizeof *kernel); a++) {
            s = usual(kernel[a], background[p], FLOW_NO_COLLISIONS, dt);
            x = simulate(&s, o, "box_rival");
            row_info(r, kernel[a] == SPH_CORE_TRIANGLE ? "Read 2010" : "kernel", &s, "", &x);
        }
    }
}

static void kernels(report *r, const clustering_options *o, double dt)
{
    int p, a;
    report_section(r, "Kernels beside the paper's");
    for (p = 0; p < PRESSURES; p++)
        for (a = 0; a < CLUSTERING_KERNELS; a++) {
            const setting s = usual(clustering_kernels[a], background[p], FLOW_NO_COLLISIONS, dt);
            const result x = simulate(&s, o, "box_kernels");
            row_info(r, "kernel", &s, "", &x);
        }
}

/* A slope at the origin has no direction there, and neither have collisions: no remedy parts two particles at one point. Collisions one after the other do by chance of their order: one of the two meets a third
   particle first and has another velocity then. */
static void coincident_pairs(report *r, const clustering_options *o, double dt)
{
    static const int remedy[] = {FLOW_NO_COLLISIONS, FLOW_WEIGHTED, FLOW_SEQUENTIAL};
    int a;
    report_section(r, "beyond the paper: 20 pairs that start at one point");
    for (a = 0; a < 3; a++) {
        setting s = usual(a ? SPH_WENDLAND_C2_1D : SPH_CONVEX, 0, remedy[a], dt);
        result x;
        s.coincident = 20;
        s.tend = 0.5;
        x = simulate(&s, o, "box_coincident");
        if (a < 2)
            report_range(r, "beyond", describe(&s), "particles that still coincide at t = .5", (double)NAN,
                         (double)x.coincident, 40, 40);
        else
            report_info(r, "beyond", describe(&s), "particles that still coincide at t = .5",
                        (double)x.coincident);
    }
}

/* Figure 2: one dimension, h = 1 */
static void figure2(const char *figures)
{
    static const sph_kernel k[] = {SPH_LIU_QUARTIC, SPH_WENDLAND_C2_1D, SPH_CONVEX};
    part_file to;
    int i, a;
    clustering_figure(&to, figures, "clustering_fig2");
    fprintf(to.to, "R,W quartic,W (1.1),W (3.9),dW quartic,dW (1.1),dW (3.9)\n");
    for (i = 0; i <= 200; i++) {
        const double R = i ? 0.01 * i : 1e-9; /* the slope of (3.9) at 0 is that from the right */
        fprintf(to.to, "%g", R);
        for (a = 0; a < 3; a++) fprintf(to.to, ",%.9g", sph_kernel_w(k[a], 1, R, 1));
        for (a = 0; a < 3; a++) fprintf(to.to, ",%.9g", sph_kernel_dwdr(k[a], 1, R, 1));
        fprintf(to.to, "\n");
    }
    clustering_figure_close(&to);
}

static void own_run(report *r, const clustering_options *o)
{
    setting s = usual(clustering_kernel(o), 0, clustering_remedy(o), clustering_choose(o->dt, 1e-4));
    int p;
    s.smoothing = clustering_choose(o->h, 2);
    s.tend = clustering_choose(o->tend, 2);
    report_section(r, "a run of one's own");
    for (p = 0; p < PRESSURES; p++) {
        result x;
        s.p0 = background[p];
        s.figure = p ? "clustering_box_own_p0" : "clustering_box_own_0";
        x = simulate(&s, o, s.figure);
        row_info(r, "own", &s, "", &x);
        report_info(r, "own", describe(&s), "CPU microseconds per particle and step", x.microseconds);
    }
}

int main(int argc, char **argv)
{
    clustering_options o = clustering_defaults();
    const option_spec specs[] = {CLUSTERING_OPTIONS(o)};
    static report r;
    double dt;
    options_parse(argc, argv,
                  "Section V.I of the paper on particle clustering: the gas-filled box. Without -full: one "
                  "seed of three, time steps of 5e-4 instead of 1e-4, "
                  "few studies.",
                  specs, CLUSTERING_OPTION_COUNT);
    report_open(&r, "clustering_box", o.out);
    if (o.kernel) {
        own_run(&r, &o);
        return report_close(&r) ? 1 : 0;
    }
    o.dref = o.h = o.tend = 0;
    dt = clustering_choose(o.dt, o.full ? 1e-4 : 5e-4);
    if (o.full || o.kernels) kernels(&r, &o, dt);
    if (o.kernels) return report_close(&r) ? 1 : 0;
    figure2(o.figures);
    linear_functions(&r);
    paper_runs(&r, &o, o.full ? 3 : 1, dt);
    rebuttal(&r, &o, o.full, dt);
    larger_smoothing(&r, &o, o.full, o.full ? dt : 1e-3);
    coincident_pairs(&r, &o, o.full ? dt : 1e-3);
    if (o.full) {
        literal(&r, &o, dt);
        restitution_study(&r, &o, dt);
        rivals(&r, &o, dt);
    }
    return report_close(&r) ? 1 : 0;
}
