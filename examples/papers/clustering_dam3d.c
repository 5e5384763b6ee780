/* SPDX-License-Identifier: MIT
 *
 * clustering_dam3d.c - beyond the paper on particle clustering: a column of water collapses in three dimensions, with walls as the paper has them (its dam break is clustering_dam.c, in two).
 *
 *     cc -O2 -o clustering_dam3d examples/papers/clustering_dam3d.c -lm
 *     clustering_dam3d -out DIR -figures DIR [-vtk] [-full]       (-h for help)
 *
 * Column of a x 2a, a wide, in a channel of 5a, with walls at the sides (a = 57.15 mm, as Martin & Moyce 1952); cubic lattice of dref = a/10, -full: a/20; rho0 = 1000, c = 10 sqrt(2 g a), p0 = 0, alpha = 0.01,
 * Wendland C2, h = 1.5 dref, (5.23) and (5.24), dt = 0.2 h / c, ghosts of zero pressure behind the walls and collisions with them. The same in two dimensions, on a square lattice, stands beside it.
 */
#include "clustering.h"
#include "../common/column.h"

enum { PICTURES = 40 };
static const sph_kernel wendland = SPH_WENDLAND_C2;
static const double water = 1000, skin = 0.3, distance = 0.85,
                    restitution = 0.01; /* in dref; of collisions as in the paper */

typedef struct dam {
    int dim, n, n_fluid;
    double dref, h, c;
    double *x[3], *v[3], *a[3], *old[3], *m, *rho, *p, *sound, *inverse_mass, *volume, *divergence;
    unsigned char *ghost;
    search_grid grid;
    search_lists all, colliding;
    int64_t steps;
} dam;

static sph_points points(const dam *d, double *const x[3])
{
    return sph_points_separate(d->n, x[0], x[1], x[2]);
}
static sph_tait water_of(const dam *d)
{
    const sph_tait t = {.rho0 = water, .c = d->c, .gamma = 1};
    return t;
}
/* y is up, z across; 2D: one layer of cells in z, and no walls there. Only what the water can reach has walls. */
static void fill(dam *d, int dim, int resolution)
{
    double **const arrays[] = {&d->x[0],   &d->x[1],         &d->x[2],   &d->v[0],      &d->v[1],
                               &d->v[2],   &d->a[0],         &d->a[1],   &d->a[2],      &d->old[0],
                               &d->old[1], &d->old[2],       &d->m,      &d->rho,       &d->p,
                               &d->sound,  &d->inverse_mass, &d->volume, &d->divergence};
    const int reach = 3, across = dim > 2 ? resolution : 1,
              sides = dim > 2 ? reach : 0; /* layers of 2h / dref */
    const int total = (5 * resolution + 2 * reach) * (3 * resolution + 2 * reach) * (across + 2 * sides);
    size_t k;
    sph_tait state;
    int ghosts, i, j, l;
    memset(d, 0, sizeof *d);
    d->dim = dim;
    d->dref = column_a / resolution;
    d->h = 1.5 * d->dref;
    d->c = 10 * sqrt(2 * column_gravity * column_a);
    state = water_of(d);
    for (k = 0; k < sizeof arrays / sizeof *arrays; k++)
        *arrays[k] = (double *)need(NULL, (size_t)total, sizeof(double));
    d->ghost = (unsigned char *)need(NULL, (size_t)total, 1);
    for (ghosts = 0; ghosts < 2; ghosts++)
        for (i = -reach; i < 5 * resolution + reach; i++)
            for (j = -reach; j < 3 * resolution; j++)
                for (l = -sides; l < across + sides; l++) {
                    const int fluid =
                        i >= 0 && i < resolution && j >= 0 && j < 2 * resolution && l >= 0 && l < across;
                    const int wall = i < 0 || i >= 5 * resolution || j < 0 || l < 0 || l >= across;
                    const double y = (j + 0.5) * d->dref,
                                 V = dim > 2 ? d->dref * d->dref * d->dref : d->dref * d->dref;
                    const int n = d->n;
                    if (ghosts ? !wall : !fluid) continue;
                    d->n++;
                    d->n_fluid += !ghosts;
                    d->x[0][n] = (i + 0.5) * d->dref;
                    d->x[1][n] = y;
                    d->x[2][n] = (l + 0.5) * d->dref;
                    d->v[0][n] = d->v[1][n] = d->v[2][n] = 0;
                    d->p[n] = ghosts ? 0 : water * column_gravity * (2 * column_a - y);
                    d->rho[n] = sph_density_tait(d->p[n], state);
                    d->m[n] = d->rho[n] * V;
                    d->inverse_mass[n] = ghosts ? 0 : 1 / d->m[n];
                    d->sound[n] = d->c;
                    d->ghost[n] = (unsigned char)ghosts;
                }
}
static void dam_close(dam *d)
{
    double *const arrays[] = {d->x[0], d->x[1],  d->x[2],         d->v[0],   d->v[1],      d->v[2], d->a[0],
                              d->a[1], d->a[2],  d->old[0],       d->old[1], d->old[2],    d->m,    d->rho,
                              d->p,    d->sound, d->inverse_mass, d->volume, d->divergence};
    size_t k;
    for (k = 0; k < sizeof arrays / sizeof *arrays; k++) free(arrays[k]);
    free(d->ghost);
    search_grid_close(&d->grid);
    search_lists_close(&d->all);
    search_lists_close(&d->colliding);
}

/* ---------------------------------------------------------------- a step; dim is a constant where these are called, so that the operators see one */

SPH_FN void find_neighbours(int dim, dam *d)
{
    const double reach = sph_kernel_support_ratio(wendland) * d->h + skin * d->dref,
                 touching = (distance + skin) * d->dref;
    const sph_points now = points(d, d->x);
    sph_query query = sph_query_of(now, SPH_GATHER, sph_scalars_same(&reach), 0);
    int k;
    if (d->all.start && !sph_rebuild_due(dim, now, points(d, d->old), skin * d->dref)) return;
    search_grid_build(&d->grid, dim, now, reach);
    query.targets.n = d->n_fluid;
    search_lists_find(&d->all, dim, &d->grid, query);
    query.radius = sph_scalars_same(&touching);
    query.flags = SPH_LIST_SORTED;
    search_lists_find(&d->colliding, dim, &d->grid, query);
    neighbours_mixed(&d->colliding, d->n_fluid, d->ghost);
    for (k = 0; k < dim; k++) memcpy(d->old[k], d->x[k], (size_t)d->n * sizeof(double));
}

static sph_cloud targets(const dam *d, long first, long last)
{
    return sph_cloud_range(
        sph_cloud_of(points(d, d->x), search_list(&d->all), sph_scalars_same(&d->h), sph_scalars_none()),
        (sph_index)first, (sph_index)last);
}
SPH_FN long rates(int dim, const dam *d, long first, long last)
{
    const sph_fluid_out out = {.acceleration = vectors_into(d->a, dim)};
    sph_fluid s;
    s.m = sph_scalars_array(d->m);
    s.rho = sph_scalars_array(d->rho);
    s.p = sph_scalars_array(d->p);
    s.c = sph_scalars_array(d->sound);
    s.v = vectors_of(d->v, dim);
    s.viscosity = SPH_VISCOSITY_MONAGHAN;
    s.alpha = 0.01;
    s.beta = 0;
    s.eta = 0.1;
    return sph_fluid_rates_colagrossi(wendland, dim, targets(d, first, last), s, out);
}
SPH_FN long divergence(int dim, const dam *d, long first, long last)
{
    static const double one = 1;
    sph_medium g;
    g.m = sph_scalars_array(d->volume);
    g.rho = g.omega = sph_scalars_same(&one);
    return sph_divergence_difference(wendland, dim, targets(d, first, last), g, vectors_of(d->v, dim),
                                     sph_scalar_out_array(d->divergence, 0));
}
/* what each thread does of them */
static long rates_part(void *data, long first, long last)
{
    const dam *const d = (const dam *)data;
    return d->dim > 2 ? rates(3, d, first, last) : rates(2, d, first, last);
}
static long divergence_part(void *data, long first, long last)
{
    const dam *const d = (const dam *)data;
    return d->dim > 2 ? divergence(3, d, first, last) : divergence(2, d, first, last);
}

SPH_FN void step(int dim, dam *d, double dt)
{
    const sph_collision collision = {distance * d->dref, restitution, sph_scalars_array(d->inverse_mass)};
    const sph_tait state = water_of(d);
    sph_cloud colliding;
    int i, k;
    find_neighbours(dim, d);
    colliding = targets(d, 0, d->n_fluid);
    colliding.list = search_list(&d->colliding);
    for (i = 0; i < d->n_fluid; i++) d->p[i] = sph_pressure_tait(d->rho[i], state);
    expect((sph_index)threads_each(d->n_fluid, rates_part, d));
    for (i = 0; i < d->n_fluid; i++) {
        d->a[1][i] -= column_gravity;
        for (k = 0; k < dim; k++) d->v[k][i] += dt * d->a[k][i];
    }
    expect(sph_collision_sequential(dim, colliding, collision, vectors_into(d->v, dim), NULL));
    for (i = 0; i < d->n; i++) d->volume[i] = d->m[i] / d->rho[i];
    expect((sph_index)threads_each(d->n_fluid, divergence_part, d));
    for (i = 0; i < d->n_fluid; i++) {
        d->rho[i] -= dt * d->rho[i] * d->divergence[i];
        for (k = 0; k < dim; k++) d->x[k][i] += dt * d->v[k][i];
    }
    d->steps++;
}

/* The first particle that cannot go on, or -1. */
static int unwell(const dam *d, double dt)
{
    int i, k;
    for (i = 0; i < d->n_fluid; i++) {
        double v2 = 0;
        for (k = 0; k < d->dim; k++) v2 += d->v[k][i] * d->v[k][i];
        if (!(d->rho[i] > 0) || !isfinite(d->rho[i]) || !(sqrt(v2) * dt <= d->h)) return i;
    }
    return -1;
}

/* ---------------------------------------------------------------- a run until T = 3.4 */

typedef struct outcome {
    front_record front;
    int lost; /* particles beyond a wall by more than dref / 2 */
    double fastest, microseconds;
} outcome;

static double front(const dam *d)
{
    double x = 0;
    int i;
    for (i = 0; i < d->n_fluid; i++)
        if (d->x[1][i] < 0.5 * column_a) x = fmax(x, d->x[0][i]);
    return x;
}
static void picture(const dam *d, vtk_series *series, double t)
{
    const vtk_field fields[] = {{"velocity", d->v[0], d->v[1], d->v[2], NULL},
                                {"density", d->rho, NULL, NULL, NULL},
                                {"pressure", d->p, NULL, NULL, NULL},
                                {"ghost", NULL, NULL, NULL, d->ghost}};
    clustering_written(vtk_series_add(series, t, d->n, d->x[0], d->x[1], d->x[2], fields, 4), series->dir,
                       series->name);
}
static void snapshot(const dam *d, const char *figures, const char *name)
{
    part_file to;
    int i;
    clustering_figure(&to, figures, name);
    fprintf(to.to, "x,y,z,vx,vy,vz,p\n");
    for (i = 0; i < d->n_fluid; i++)
        fprintf(to.to, "%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", d->x[0][i], d->x[1][i], d->x[2][i], d->v[0][i],
                d->v[1][i], d->v[2][i], d->p[i]);
    clustering_figure_close(&to);
}

static void run(const clustering_options *c, int dim, int resolution, outcome *o)
{
    const double end = 3.4 / column_T(1);
    const char *const name = dim > 2 ? "clustering_dam3d_box" : "clustering_dam3d_plane";
    const clock_t begin = clock();
    vtk_series series = {0};
    progress bar;
    int64_t s, steps, every;
    double dt;
    dam d;
    int i, bad;
    fill(&d, dim, resolution);
    dt = 0.2 * d.h / d.c;
    steps = (int64_t)ceil(end / dt);
    every = steps / PICTURES + 1;
    o->front.count = 0;
    o->front.every = end / (FRONT_SAMPLES - 1);
    front_add(&o->front, 0, front(&d));
    signal(SIGINT, clustering_on_signal);
    signal(SIGTERM, clustering_on_signal);
    progress_begin(&bar, name, c->quiet);
    vtk_series_begin(&series, c->out, name);
    if (c->vtk) picture(&d, &series, 0);
    for (s = 0; s < steps; s++) {
        const double t = (double)(s + 1) * dt;
        if (dim > 2) step(3, &d, dt);
        else step(2, &d, dt);
        bad = unwell(&d, dt);
        if (bad >= 0 || clustering_signal) {
            fflush(stdout);
            if (bad >= 0)
                fprintf(stderr, "%s: blew up at t = %g: particle %d at (%g, %g, %g)\n", name, t, bad,
                        d.x[0][bad], d.x[1][bad], d.x[2][bad]);
            else
                fprintf(stderr,
                        "%s: interrupted at t = %g; the rows of the table so far are in its .part file\n",
                        name, t);
            exit(bad >= 0 ? 3 : 130);
        }
        if (front_due(&o->front, t)) front_add(&o->front, t, front(&d));
        if (c->vtk && ((s + 1) % every == 0 || s + 1 == steps)) picture(&d, &series, t);
        progress_update(&bar, (double)(s + 1) / (double)steps);
    }
    progress_end(&bar);
    vtk_series_end(&series);
    o->lost = 0;
    o->fastest = 0;
    for (i = 0; i < d.n_fluid; i++) {
        const double half = 0.5 * d.dref, width = dim > 2 ? column_a : d.dref;
        o->lost += d.x[0][i] < -half || d.x[0][i] > 5 * column_a + half || d.x[1][i] < -half ||
                   d.x[2][i] < -half || d.x[2][i] > width + half;
        o->fastest =
            fmax(o->fastest, sqrt(d.v[0][i] * d.v[0][i] + d.v[1][i] * d.v[1][i] + d.v[2][i] * d.v[2][i]));
    }
    o->microseconds = 1e6 * (double)(clock() - begin) / CLOCKS_PER_SEC / ((double)d.steps * d.n_fluid);
    snapshot(&d, c->figures, name);
    dam_close(&d);
}

int main(int argc, char **argv)
{
    clustering_options c = clustering_defaults();
    int resolution = 0, dim, k;
    const option_spec specs[] = {
        {"resolution", "particles on the length a; 0: 10, with -full 20", OPTION_INT, &resolution, 0, 200},
        {"out", "folder of the result table (and of VTK files)", OPTION_TEXT, &c.out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &c.figures, 0, 0},
        {"full", "dref = a/20", OPTION_FLAG, &c.full, 0, 0},
        {"vtk", "write 40 pictures of each run for ParaView", OPTION_FLAG, &c.vtk, 0, 0},
        {"quiet", "no progress on the terminal", OPTION_FLAG, &c.quiet, 0, 0},
        THREADS_OPTION};
    static const char *const name[] = {"two dimensions, square lattice", "three dimensions"},
                             *const file[] = {"plane", "space"};
    static report r;
    static outcome o[2];
    part_file to;
    char text[96];
    double mean = 0;
    options_parse(argc, argv,
                  "A column of water of a x 2a x a collapses in a channel: three dimensions beside two and "
                  "beside Martin & Moyce 1952.",
                  specs, (int)(sizeof specs / sizeof *specs));
    report_open(&r, "clustering_dam3d", c.out);
    if (resolution == 0) resolution = c.full ? 20 : 10;
    snprintf(text, sizeof text, "A column of a x 2a x a, dref = a/%d", resolution);
    report_section(&r, text);
    clustering_figure(&to, c.figures, "clustering_column3d");
    fprintf(to.to, "run,T,Z\n");
    column_experiment_lines(to.to);
    for (dim = 2; dim <= 3; dim++) {
        outcome *const x = &o[dim - 2];
        run(&c, dim, resolution, x);
        column_lines(to.to, file[dim - 2], &x->front);
        column_rows(&r, name[dim - 2], &x->front, dim > 2);
        report_range(&r, "column", name[dim - 2], "particles outside of the walls", (double)NAN, x->lost, 0,
                     0);
        report_info(&r, "column", name[dim - 2], "fastest particle at T = 3.4 / sqrt(2 g a)",
                    x->fastest / sqrt(2 * column_gravity * column_a));
        report_info(&r, "column", name[dim - 2], "CPU time of a fluid particle and step [us]",
                    x->microseconds);
    }
    clustering_figure_close(&to);
    for (k = 0; k < MARTIN; k++)
        mean += (front_at(&o[1].front, martin_T[k] / column_T(1)) /
                     front_at(&o[0].front, martin_T[k] / column_T(1)) -
                 1) /
                MARTIN;
    report_range(&r, "column", "three dimensions beside two",
                 "mean of Z / Z - 1 at the times of Martin & Moyce", (double)NAN, mean, -0.1, 0.1);
    return report_close(&r) ? 1 : 0;
}
