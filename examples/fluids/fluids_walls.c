/* SPDX-License-Identifier: MIT
 *
 * fluids_walls.c - four ways to make a wall, side by side: water at rest above a floor, and a viscous flow between
 * plates.
 *
 *     cc -O2 -o fluids_walls examples/fluids/fluids_walls.c -lm
 *     fluids_walls -out DIR -figures DIR [-full]       (-h for help)
 *
 *     Adami    wall particles take the mean of the fluid around them, and the weight of it (sph_wall_adami)
 *     mDBC     they take what lies at their mirror points, by Liu & Liu's fit (sph_interpolate_liu)
 *     MLS      the same by moving least squares (sph_interpolate_mls)
 *     gamma    no wall particles: boundary integrals (sph_wall_gamma). Of the pressure, p_i + p_j over the fluid less
 *              p_i + p_w over the wall; of the density rate, the wall's term likewise; of viscosity, the Laplacian
 *              with the gradient (v_w - v_i) / d at the wall (sph_wall_laplacian)
 *
 * All have Fourtakas's density diffusion, without which gamma's water at rest does not stay there: from t = 1.2 on
 * sound grows, because these sums of pressure and of density rate are not adjoint.
 *
 * Floor: 20 rows of water, periodic sideways, h = 1.6 dx, c0 = 20 sqrt(gH), alpha = 0.1, from rest with
 * p = rho g (H - y) to t = 5 sqrt(H / g). Lengths are in H. Figures: rms error of the pressure of the lowest row, in
 * rho g H; rms speed of all, in sqrt(gH), which is spurious; rise of the centre of mass.
 * Plates: Poiseuille's flow at Re = 1 (../papers/clustering_plates.h), 20 rows, t = 1. Figures: rms error of the
 * speed, in the largest; error of the mean speed of the two rows at the plates, in the same; the largest speed
 * across, which is 0. Morris's viscosity for wall particles, Brookshaw's Laplacian for gamma.
 */
#include "fluids.h"
#include "../papers/clustering_plates.h"

typedef enum wall_kind { WALL_ADAMI, WALL_MDBC, WALL_MLS, WALL_GAMMA, WALLS } wall_kind;
enum { ELEMENTS = 64, ROWS = 20 };
enum { PRESSURE, SPEED, RISE, FLOW, AT_PLATES, ACROSS, FIGURES };

static struct {
    wall_kind kind;
    int plates, elements; /* plates: 1, the lid is a wall, too */
    double mu, force;
    double ax[ELEMENTS], ay[ELEMENTS], bx[ELEMENTS], by[ELEMENTS];
    double *gamma, *nabla[2], *slope[2], *laplacian, *volume, *memory;
    sph_index *start, *index; /* the elements near each particle */
} wall;

/* Distance to the wall that is nearer, and its height. */
static double depth(const flow *f, int i) { return wall.plates ? fmin(f->y[i], 1 - f->y[i]) : f->y[i]; }
static double side(const flow *f, int i) { return wall.plates && f->y[i] > 0.5 ? 1 : -1; } /* of the normal */

/* ---------------------------------------------------------------- wall particles by their mirror points */

/* value and gradient of `field` at the mirror points of all wall particles */
static void fit(const flow *f, sph_cloud mirrors, const double *field, double *value, double *gx, double *gy)
{
    const sph_interpolation_options options = {.conditioning_min = 1e-3};
    const sph_interpolation_out out = {.value = value, .gx = gx, .gy = gy};
    sph_sources sources = {flow_points(f), sph_scalars_array(wall.volume)};
    sources.points.n = f->n_fluid;
    expect(wall.kind == WALL_MDBC
               ? sph_interpolate_liu(SPH_WENDLAND_C2, 2, mirrors, sources, sph_scalars_array(field), options, out)
               : sph_interpolate_mls(SPH_WENDLAND_C2, 2, mirrors, sources, sph_scalars_array(field), options, out));
}
static void mirrored(flow *f)
{
    viscous *const w = (viscous *)f->data;
    const int count = f->n - f->n_fluid;
    const double reach = sph_kernel_support_ratio(f->kernel) * f->h;
    double *const x = (double *)need(NULL, 6 * (size_t)count, sizeof *x), *const y = x + count, *const value = x + 2 * count,
                  *const gx = x + 3 * count, *const gy = x + 4 * count, *const none = x + 5 * count;
    search_grid grid = {0};
    search_lists lists = {0};
    sph_points water = flow_points(f), points;
    sph_cloud mirrors;
    int k;
    for (k = 0; k < count; k++) {
        x[k] = f->x[f->n_fluid + k];
        y[k] = f->y[f->n_fluid + k] > 0.5 ? 2 - f->y[f->n_fluid + k] : -f->y[f->n_fluid + k];
    }
    for (k = 0; k < f->n_fluid; k++) wall.volume[k] = f->m[k] / f->rho[k];
    points = sph_points_separate(count, x, y, NULL);
    points.box = water.box;
    water.n = f->n_fluid;
    search_grid_build(&grid, 2, water, reach);
    search_lists_find(&lists, 2, &grid, sph_query_of(points, SPH_GATHER, sph_scalars_same(&reach), SPH_LIST_FOREIGN));
    mirrors = sph_cloud_of(points, search_list(&lists), sph_scalars_same(&f->h), sph_scalars_none());
    fit(f, mirrors, f->p, value, gx, gy);
    for (k = 0; k < count; k++) {
        const sph_vec gradient = {gx[k], gy[k], 0}, away = {0, f->y[f->n_fluid + k] - y[k], 0};
        w->wall_p[f->n_fluid + k] = sph_fit_extend(2, value[k], gradient, away);
    }
    fit(f, mirrors, f->vx, value, none, none);
    for (k = 0; k < count; k++) w->wall_vx[f->n_fluid + k] = 2 * f->vx[f->n_fluid + k] - value[k];
    fit(f, mirrors, f->vy, value, none, none);
    for (k = 0; k < count; k++) w->wall_vy[f->n_fluid + k] = 2 * f->vy[f->n_fluid + k] - value[k];
    for (k = f->n_fluid; k < f->n; k++) {
        f->p[k] = w->wall_p[k];
        f->rho[k] = sph_density_tait(f->p[k], f->state[0]);
    }
    search_lists_close(&lists);
    search_grid_close(&grid);
    free(x);
}

/* ---------------------------------------------------------------- walls by boundary integrals */

static void find_gamma(flow *f)
{
    const double reach = sph_kernel_support_ratio(f->kernel) * f->h;
    const sph_wall_elements elements = {.n = wall.elements,
                                        .a = sph_vectors_separate(wall.ax, wall.ay, NULL),
                                        .b = sph_vectors_separate(wall.bx, wall.by, NULL),
                                        .list = {wall.start, wall.index}};
    int i, e, entries = 0;
    for (i = 0; i < f->n_fluid; i++) { /* the elements that a support may touch */
        wall.start[i] = (sph_index)entries;
        for (e = 0; depth(f, i) < reach && e < wall.elements; e++) {
            const double away = f->x[i] - 0.5 * (wall.ax[e] + wall.bx[e]), near_by = away - f->box_x * floor(away / f->box_x + 0.5);
            if (fabs(f->y[i] - wall.ay[e]) < reach && fabs(near_by) < reach + 0.5 * fabs(wall.bx[e] - wall.ax[e]))
                wall.index[entries++] = (sph_index)e;
        }
    }
    wall.start[f->n_fluid] = (sph_index)entries;
    const sph_wall_gamma_out out = {.gamma = wall.gamma, .gradient = vectors_into(wall.nabla, 2)};
    expect(sph_wall_gamma(SPH_WENDLAND_C2, 2, flow_fluid(f), elements, out));
}
/* Of a sum over the fluid, with the value at the wall. */
static sph_vec closed(int i, double sx, double sy, double at_wall)
{
    const sph_vec sum = {sx, sy, 0}, nabla = {wall.nabla[0][i], wall.nabla[1][i], 0};
    return sph_wall_gradient_value(2, sum, at_wall, wall.gamma[i], nabla);
}
/* the rates of density at new places, of walls that are at rest */
static void closed_rates(flow *f)
{
    int i;
    find_gamma(f);
    for (i = 0; i < f->n_fluid; i++) /* -rho div v; the difference v_w - v_i stands in the place of f_w */
        f->rate[i] = closed(i, f->rate[i], 0, f->rho[i] * f->vx[i]).x + closed(i, 0, 0, f->rho[i] * f->vy[i]).y;
}
static void closed_forces(flow *f)
{
    const sph_wall_terms terms = {.gamma = sph_scalars_array(wall.gamma),
                                  .gradient = vectors_of(wall.nabla, 2),
                                  .slope = vectors_of(wall.slope, 2)};
    sph_cloud targets = flow_fluid(f);
    int i, axis;
    if (!liquid_of(f)->started) find_gamma(f); /* there have been no rates yet */
    for (i = 0; i < f->n_fluid; i++) {
        const double p_w = f->p[i] - (wall.plates ? 0 : f->rho[i] * f->gravity_y * depth(f, i)); /* at rest */
        const sph_vec a = closed(i, -f->rho[i] * f->ax[i], -f->rho[i] * f->ay[i], f->p[i] + p_w);
        f->ax[i] = -a.x / f->rho[i] + wall.force;
        f->ay[i] = -a.y / f->rho[i];
        wall.volume[i] = f->m[i] / f->rho[i];
    }
    targets.volume = sph_scalars_array(wall.volume);
    for (axis = 0; axis < 2 && wall.mu > 0; axis++) {
        const double *const v = axis ? f->vy : f->vx;
        for (i = 0; i < f->n_fluid; i++) {
            wall.slope[0][i] = 0;
            wall.slope[1][i] = -v[i] / fmax(depth(f, i), 0.1 * f->dref) * side(f, i);
        }
        expect(sph_wall_laplacian(SPH_WENDLAND_C2, 2, targets, terms, sph_scalars_array(v),
                                  sph_scalar_out_array(wall.laplacian, NULL)));
        for (i = 0; i < f->n_fluid; i++) (axis ? f->ay : f->ax)[i] += wall.mu / f->rho[i] * wall.laplacian[i];
    }
}
/* ---------------------------------------------------------------- cases */

static void wall_begin(liquid *l, wall_kind kind, int plates, double mu, double force, const fluids_options *o)
{
    flow *const f = &l->f;
    const int each = ELEMENTS / 2;
    int e, side_of;
    if (kind == WALL_GAMMA) f->n = f->n_fluid; /* no wall particles */
    liquid_start(l, mu, o);
    l->w.body_force = force;
    memset(&wall, 0, sizeof wall);
    wall.kind = kind;
    wall.plates = plates;
    wall.mu = mu;
    wall.force = force;
    wall.memory = (double *)need_zeros(7 * (size_t)f->n, sizeof(double));
    wall.start = (sph_index *)need_zeros((size_t)f->n + 1, sizeof *wall.start);
    wall.index = (sph_index *)need_zeros((size_t)f->n * ELEMENTS, sizeof *wall.index);
    wall.gamma = wall.memory;
    wall.nabla[0] = wall.memory + f->n;
    wall.nabla[1] = wall.memory + 2 * f->n;
    wall.slope[0] = wall.memory + 3 * f->n;
    wall.slope[1] = wall.memory + 4 * f->n;
    wall.laplacian = wall.memory + 5 * f->n;
    wall.volume = wall.memory + 6 * f->n;
    for (side_of = 0; side_of < (plates ? 2 : 1); side_of++)
        for (e = 0; e < each; e++, wall.elements++) { /* the fluid on the left */
            const double from = f->box_x * e / each, to = f->box_x * (e + 1) / each;
            wall.ax[wall.elements] = side_of ? to : from;
            wall.bx[wall.elements] = side_of ? from : to;
            wall.ay[wall.elements] = wall.by[wall.elements] = side_of;
        }
    if (kind == WALL_MDBC || kind == WALL_MLS) f->ghosts = mirrored;
    if (kind == WALL_GAMMA) {
        f->force = closed_forces;
        l->rated = closed_rates;
    }
}
static double wall_end(liquid *l)
{
    const double cost = flow_microseconds(&l->f);
    free(wall.memory);
    free(wall.start);
    free(wall.index);
    liquid_close(l);
    return cost;
}
static const liquid_method *method_of(wall_kind kind)
{
    static const liquid_method methods[WALLS] = {
        {.name = "Adami", .file = "adami", .diffusion = LIQUID_FOURTAKAS},
        {.name = "mDBC", .file = "mdbc", .diffusion = LIQUID_FOURTAKAS},
        {.name = "MLS", .file = "mls", .diffusion = LIQUID_FOURTAKAS},
        {.name = "gamma", .file = "gamma", .diffusion = LIQUID_FOURTAKAS}};
    return &methods[kind];
}
static double floor_case(wall_kind kind, int seed, const fluids_options *o, double *figure)
{
    const double dx = 1.0 / ROWS;
    liquid l;
    double before, pressure = 0, speed = 0;
    int i, j, row = 0;
    liquid_open(&l, method_of(kind), dx, 1.6 * dx, 20, 0.1);
    l.f.gravity_y = -1;
    l.f.box_x = 1;
    for (j = 0; j < ROWS; j++)
        for (i = 0; i < ROWS; i++) liquid_add(&l, (i + 0.5) * dx, (j + 0.5) * dx, 1 - (j + 0.5) * dx);
    for (j = -4; j < 0; j++)
        for (i = 0; i < ROWS; i++) flow_add_ghost(&l.f, (i + 0.5) * dx, (j + 0.5) * dx, 0, dx * dx);
    wall_begin(&l, kind, 0, 0, 0, o);
    liquid_shake(&l, seed);
    before = liquid_height(&l);
    flow_require(&l.f, flow_run(&l.f, 5));
    for (i = 0; i < l.f.n_fluid; i++) {
        const double off = l.f.p[i] - (1 - l.f.y[i]);
        if (l.f.y[i] < dx) {
            pressure += off * off;
            row++;
        }
        speed += (l.f.vx[i] * l.f.vx[i] + l.f.vy[i] * l.f.vy[i]) / l.f.n_fluid;
    }
    figure[PRESSURE] = row ? sqrt(pressure / row) : 1;
    figure[SPEED] = sqrt(speed);
    figure[RISE] = liquid_height(&l) - before;
    return wall_end(&l);
}
static double plates_case(wall_kind kind, int seed, const fluids_options *o, double *figure)
{
    const double dref = 1 / (ROWS * hexagonal), c0 = 10;
    liquid l;
    double at_plates = 0;
    int i, count = 0;
    liquid_open(&l, method_of(kind), dref, 1.5 * dref, c0, 0);
    l.f.dt = fmin(0.25 * l.f.h / (c0 + 1), 0.125 * l.f.h * l.f.h);
    plates_fill(&l.f, 0, ROWS);
    wall_begin(&l, kind, 1, 1, plates_force(0), o);
    liquid_shake(&l, seed);
    flow_require(&l.f, flow_run(&l.f, 1));
    figure[FLOW] = plates_error(&l.f, 0);
    figure[ACROSS] = 0;
    for (i = 0; i < l.f.n_fluid; i++) {
        if (depth(&l.f, i) < 1.0 / ROWS) {
            at_plates += l.f.vx[i] - plates_speed(0, l.f.y[i], l.f.t);
            count++;
        }
        figure[ACROSS] = fmax(figure[ACROSS], fabs(l.f.vy[i]));
    }
    figure[AT_PLATES] = count ? fabs(at_plates / count) : 1;
    return wall_end(&l);
}

int main(int argc, char **argv)
{
    static const char *const quantity[FIGURES] = {"pressure error, lowest row", "spurious speed", "rise of the centre",
                                                  "rms error of the speed", "speed at the plates", "speed across"};
    fluids_options o = {".", ".", NULL, 0, 0, 0};
    const option_spec specs[] = {FLUIDS_OPTIONS(o)};
    static report r;
    static double figure[WALLS][FIGURES], cost[WALLS][2];
    int k, c, s, tried = 0;
    options_parse(argc, argv, "Four ways to make a wall: water at rest, and a flow between plates.", specs,
                  FLUIDS_OPTION_COUNT);
    report_open(&r, "fluids_walls", o.out);
    figure_folder(o.figures, "fluids_walls");
    for (k = 0; k < WALLS; k++) {
        const char *const name = method_of((wall_kind)k)->name;
        double low[FIGURES], high[FIGURES];
        if (o.method && strcmp(o.method, method_of((wall_kind)k)->file) != 0) continue;
        tried++;
        cost[k][0] = floor_case((wall_kind)k, 0, &o, figure[k]);
        cost[k][1] = plates_case((wall_kind)k, 0, &o, figure[k]);
        for (s = 1; s <= LIQUID_SEEDS && o.full; s++) {
            double seen[FIGURES];
            floor_case((wall_kind)k, s, &o, seen);
            plates_case((wall_kind)k, s, &o, seen);
            for (c = 0; c < FIGURES; c++) {
                low[c] = s == 1 ? seen[c] : fmin(low[c], seen[c]);
                high[c] = s == 1 ? seen[c] : fmax(high[c], seen[c]);
            }
        }
        for (c = 0; c < FIGURES; c++) {
            report_info(&r, c < FLOW ? "floor" : "plates", name, quantity[c], figure[k][c]);
            if (o.full) {
                char text[64];
                snprintf(text, sizeof text, "%.4g to %.4g", low[c], high[c]);
                report_row(&r, c < FLOW ? "floor" : "plates", name, quantity[c], NULL, text, "three seeds", NULL, REPORT_INFO);
            }
        }
        for (c = 0; c < 2; c++)
            report_info(&r, c ? "plates" : "floor", name, "CPU time of a particle and step [us]", cost[k][c]);
    }
    if (tried == 0) {
        fprintf(stderr, "option -method: '%s' is none of adami mdbc mls gamma\n", o.method);
        return 2;
    }
    printf("\n%-8s", "");
    for (c = 0; c < FIGURES; c++) printf(" %14.14s", quantity[c]);
    printf(" %8s %8s\n", "cost", "cost");
    for (k = 0; k < WALLS; k++) {
        if (o.method && strcmp(o.method, method_of((wall_kind)k)->file) != 0) continue;
        printf("%-8s", method_of((wall_kind)k)->name);
        for (c = 0; c < FIGURES; c++) printf(" %14.3g", figure[k][c]);
        if (o.method) printf("\n");
        else printf(" %8.2f %8.2f\n", cost[k][0] / cost[0][0], cost[k][1] / cost[0][1]);
    }
    if (o.method) return report_close(&r) ? 1 : 0;
    report_section(&r, "What each is good for");
    for (k = 0; k < WALLS; k++) {
        const char *const name = method_of((wall_kind)k)->name;
        report_range(report_beside(&r, REPORT_THEORY), "floor", name, quantity[SPEED], 0, figure[k][SPEED], 0, 1e-3);
        report_range(report_beside(&r, REPORT_THEORY), "floor", name, quantity[RISE], 0, figure[k][RISE], -1e-3, 1e-3);
        if (k != WALL_GAMMA)
            report_range(report_beside(&r, REPORT_THEORY), "floor", name, quantity[PRESSURE], 0, figure[k][PRESSURE], 0, 0.01);
        report_range(report_beside(&r, REPORT_THEORY), "plates", name, quantity[FLOW], 0, figure[k][FLOW], 0,
                     k == WALL_GAMMA ? 0.005 : 0.03);
        report_range(report_beside(&r, REPORT_THEORY), "plates", name, quantity[AT_PLATES], 0, figure[k][AT_PLATES], 0,
                     k == WALL_GAMMA ? 0.003 : 0.02);
    }
    report_range(&r, "floor", "gamma", "pressure error, lowest row: that of its sums", (double)NAN,
                 figure[WALL_GAMMA][PRESSURE], 0.02, 0.15);
    return report_close(&r) ? 1 : 0;
}
