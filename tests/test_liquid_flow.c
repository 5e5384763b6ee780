/* SPDX-License-Identifier: MIT */
/*
 * test_liquid_flow.c - what density diffusion and shifting do to a flow, good and bad: a tank at rest, Taylor-Green vortices.
 *
 * Kernel and dimension are constants, as in a user's program. A step is the one that the chapter of fluids asks for.
 */
#include "../sph.h"
#include "check.h"
#include "clouds.h"

#include <stdio.h>
#include <string.h>

#define KERNEL SPH_WENDLAND_C2
enum { NONE, MOLTENI, ANTUONO, FOURTAKAS };

typedef struct flow {
    sph_index n, wet; /* the liquid first, then walls */
    sph_points points;
    double dx, h, c, dt, t, viscosity; /* alpha of artificial viscosity for a tank; nu for a box */
    double speed; /* that shifting takes for the largest of the flow */
    int periodic, form, shifting, late; /* late: rates by the old velocities, the wrong order */
    sph_real *x, *y, *vx, *vy, *ax, *ay, *sx, *sy, *rho, *p, *m, *V, *rate, *share, *gx, *gy, *kx, *ky, *lx, *ly, *lambda, *nx, *ny, *c0, *mu, *memory;
} flow;
enum { ARRAYS = 25 };

static flow flow_new(sph_index n)
{
    flow f;
    sph_real **const a[ARRAYS] = {&f.x, &f.y, &f.vx, &f.vy, &f.ax, &f.ay, &f.sx, &f.sy, &f.rho, &f.p, &f.m, &f.V, &f.rate,
                                  &f.share, &f.gx, &f.gy, &f.kx, &f.ky, &f.lx, &f.ly, &f.lambda, &f.nx, &f.ny, &f.c0, &f.mu};
    int k;
    memset(&f, 0, sizeof f);
    f.n = f.wet = n;
    f.memory = (sph_real *)cloud_memory((size_t)n * ARRAYS, sizeof *f.memory);
    for (k = 0; k < ARRAYS; k++) *a[k] = f.memory + k * n;
    return f;
}
static sph_vectors two(sph_real *x, sph_real *y) { return sph_vectors_separate(x, y, 0); }
static sph_vector_out to(sph_real *x, sph_real *y) { return sph_vector_out_separate(x, y, 0); }
static sph_index gradient(sph_cloud all, const sph_real *of, sph_real *gx, sph_real *gy)
{
    return sph_gradient_cspm(KERNEL, 2, all, sph_scalars_array(of), (sph_derivatives_out){.gx = gx, .gy = gy});
}
/* Tait's equation with the exponent 7; the tank's gravity is 1 downwards */
static void step(flow *f)
{
    const sph_tait state = {.rho0 = SPH_R(1), .c = SPH_R(f->c), .gamma = SPH_R(7)};
    const sph_real h = SPH_R(f->h), zero = SPH_R(0), one = SPH_R(1), reach = SPH_R(2.0 * f->h);
    const size_t size = sph_search_size(2, f->n, (int64_t)f->n * 80);
    void *const memory = cloud_memory(size, 1);
    sph_neighbors found;
    sph_cloud all, wet;
    sph_fluid s = {0};
    sph_diffusion d = {0};
    sph_index i;
    if (sph_search(2, f->points, sph_scalars_same(&reach), SPH_GATHER, memory, size, &found) != 0) abort();
    for (i = 0; i < f->n; i++) f->V[i] = f->m[i] / f->rho[i];
    all = sph_cloud_of(f->points, found.list, sph_scalars_same(&h), sph_scalars_array(f->V));
    wet = sph_cloud_range(all, 0, f->wet);
    s.m = sph_scalars_array(f->m);
    s.rho = sph_scalars_array(f->rho);
    s.p = sph_scalars_array(f->p);
    s.c = sph_scalars_array(f->c0);
    s.v = two(f->vx, f->vy);
    if (f->wet < f->n) {
        sph_wall w = {0};
        w.share = sph_scalars_array(f->share);
        w.rho = s.rho;
        w.p = s.p;
        w.v = s.v;
        w.velocity.x = w.velocity.y = sph_scalars_same(&zero);
        w.gravity.y = SPH_R(-1);
        CHECK(sph_wall_adami(KERNEL, 2, sph_cloud_range(all, f->wet, f->n), w, (sph_wall_out){.p = f->sx, .v = to(f->ax, f->ay)}) >= 0);
        for (i = f->wet; i < f->n; i++) f->rho[i] = sph_density_tait(f->p[i] = f->sx[i] > 0 ? f->sx[i] : 0, state);
    }
    if (!f->periodic) {
        s.viscosity = SPH_VISCOSITY_LINEAR;
        s.alpha = SPH_R(f->viscosity);
    }
    d.tait = state;
    d.delta = SPH_R(f->form == NONE ? -1.0 : 0.1);
    d.gravity.y = SPH_R(-1);
    d.share = sph_scalars_array(f->share);
    d.gradient = two(f->gx, f->gy);
#define RATES \
    (f->form == ANTUONO     ? sph_density_diffusion_antuono(KERNEL, 2, wet, s, d, sph_scalar_out_array(f->rate, 0)) \
     : f->form == FOURTAKAS ? sph_density_diffusion_fourtakas(KERNEL, 2, wet, s, d, sph_scalar_out_array(f->rate, 0)) \
                            : sph_density_diffusion_molteni(KERNEL, 2, wet, s, d, sph_scalar_out_array(f->rate, 0)))
    if (f->form == ANTUONO) CHECK(gradient(all, f->rho, f->gx, f->gy) >= 0);
    if (f->late) CHECK(RATES == 0);
    CHECK(sph_fluid_rates_monaghan(KERNEL, 2, wet, s, (sph_fluid_out){.acceleration = to(f->ax, f->ay)}) == 0);
    if (f->periodic) {
        CHECK(sph_viscosity_mu_morris(KERNEL, 2, wet, s, sph_scalars_array(f->mu), to(f->sx, f->sy)) == 0);
        for (i = 0; i < f->wet; i++) f->ax[i] += f->sx[i], f->ay[i] += f->sy[i];
    }
    for (i = 0; i < f->wet; i++) {
        f->vx[i] += SPH_R(f->dt) * f->ax[i];
        f->vy[i] += SPH_R(f->dt) * (f->ay[i] - (f->periodic ? zero : one));
    }
    if (!f->late) CHECK(RATES == 0);
    if (f->shifting) {
        const sph_real strength = sph_shift_strength_sun(h, SPH_R(f->speed), SPH_R(f->dt), SPH_R(2.0 * f->dx));
        sph_shift shift = {0};
        shift.strength = sph_scalars_same(&strength);
        shift.tensile = SPH_R(0.2);
        shift.spacing = SPH_R(f->dx / f->h);
        if (!f->periodic) {
            CHECK(sph_free_surface(KERNEL, 2, all, (sph_surface_out){.lambda = f->lambda, .normal = to(f->nx, f->ny)}) >= 0);
            shift.lambda = sph_scalars_array(f->lambda);
            shift.normal = two(f->nx, f->ny);
        }
        CHECK(sph_shift_displacement(KERNEL, 2, wet, shift, to(f->sx, f->sy)) == 0);
        if (gradient(wet, f->rho, f->gx, f->gy) < 0 || gradient(wet, f->vx, f->kx, f->ky) < 0 || gradient(wet, f->vy, f->lx, f->ly) < 0) abort();
        for (i = 0; i < f->wet; i++) {
            f->x[i] += f->sx[i];
            f->y[i] += f->sy[i];
            f->rho[i] += f->sx[i] * f->gx[i] + f->sy[i] * f->gy[i];
            f->vx[i] += f->sx[i] * f->kx[i] + f->sy[i] * f->ky[i];
            f->vy[i] += f->sx[i] * f->lx[i] + f->sy[i] * f->ly[i];
        }
    }
    for (i = 0; i < f->wet; i++) {
        f->x[i] += SPH_R(f->dt) * f->vx[i];
        f->y[i] += SPH_R(f->dt) * f->vy[i];
        f->rho[i] += SPH_R(f->dt) * f->rate[i];
        if (!(f->rho[i] > SPH_R(0.1))) f->rho[i] = SPH_R(0.1);
        f->p[i] = sph_pressure_tait(f->rho[i], state);
    }
    f->t += f->dt;
    free(memory);
}

/* ---- a tank at rest: how far the centre of mass rises, in parts of the depth, and how far the pressure is off, rms, in parts of rho g depth ---- */

typedef struct answer {
    double first, second, clustered;
} answer;
static answer tank(int form, int shifting, int side, double end, double jitter, uint64_t seed)
{
    enum { LAYERS = 4 };
    const double dx = 1.0 / side;
    const sph_index wet = (sph_index)(side * side), most = wet + (sph_index)((side + 2 * LAYERS) * (side + LAYERS + side / 2));
    const sph_tait state = {.rho0 = SPH_R(1), .c = SPH_R(20), .gamma = SPH_R(7)};
    flow f = flow_new(most);
    double start = 0.0, y = 0.0, error = 0.0;
    pcg32 g;
    sph_index i, n = 0;
    int a, b, wall;
    answer r;
    pcg32_seed(&g, seed, 1);
    for (wall = 0; wall < 2; wall++)
        for (a = -LAYERS; a < side + LAYERS; a++)
            for (b = -LAYERS; b < side + side / 2; b++) {
                const int inside = a >= 0 && a < side && b >= 0;
                if (inside && b >= side) continue;
                if (inside == wall) continue;
                f.x[n] = SPH_R((a + 0.5 + (wall ? 0.0 : jitter * cloud_symmetric(&g))) * dx);
                f.y[n] = SPH_R((b + 0.5 + (wall ? 0.0 : jitter * cloud_symmetric(&g))) * dx);
                f.p[n] = SPH_R(wall ? 0.0 : 1.0 - (double)f.y[n]);
                f.share[n] = SPH_R(!wall);
                n++;
            }
    f.n = n;
    f.wet = wet;
    f.dx = dx;
    f.h = 1.6 * dx;
    f.c = 20.0;
    f.speed = 2.0;
    f.viscosity = 0.02;
    f.dt = 0.25 * f.h / f.c;
    f.form = form;
    f.shifting = shifting;
    f.points = sph_points_separate(n, f.x, f.y, 0);
    for (i = 0; i < n; i++) {
        f.rho[i] = sph_density_tait(f.p[i], state);
        f.m[i] = SPH_R(dx * dx);
        f.c0[i] = SPH_R(f.c);
    }
    for (i = 0; i < wet; i++) start += (double)f.y[i] / wet;
    while (f.t < end) step(&f);
    for (i = 0; i < wet; i++) {
        y += (double)f.y[i] / wet;
        error += pow((double)f.p[i] - (1.0 - (double)f.y[i]), 2.0) / wet;
    }
    r.first = y - start;
    r.second = sqrt(error);
    r.clustered = 0.0;
    free(f.memory);
    return r;
}

/* ---- Taylor-Green vortices, Re 100, from a lattice: mean error of the velocity over the exact amplitude, and the energy over that of the start ---- */

static answer vortices(int form, int shifting, int late, int side, double end, double jitter, uint64_t seed)
{
    const double dx = 1.0 / side, nu = 0.01, k = 2.0 * PI;
    flow f = flow_new((sph_index)(side * side));
    double decay, error = 0.0, size = 0.0, energy = 0.0;
    pcg32 g;
    sph_index i;
    answer r;
    pcg32_seed(&g, seed, 2);
    f.dx = dx;
    f.h = 1.6 * dx;
    f.c = 10.0;
    f.speed = 1.0;
    f.dt = 0.25 * f.h / (f.c + 1.0);
    f.periodic = 1;
    f.form = form;
    f.shifting = shifting;
    f.late = late;
    f.points = sph_points_periodic(sph_points_separate(f.n, f.x, f.y, 0), SPH_R(1), SPH_R(1), SPH_R(0));
    for (i = 0; i < f.n; i++) {
        const double x = (i % side + 0.5 + jitter * cloud_symmetric(&g)) * dx, y = (i / side + 0.5 + jitter * cloud_symmetric(&g)) * dx;
        f.x[i] = SPH_R(x);
        f.y[i] = SPH_R(y);
        f.vx[i] = SPH_R(-cos(k * x) * sin(k * y));
        f.vy[i] = SPH_R(sin(k * x) * cos(k * y));
        f.rho[i] = SPH_R(1);
        f.m[i] = SPH_R(dx * dx);
        f.c0[i] = SPH_R(f.c);
        f.mu[i] = SPH_R(nu);
        f.share[i] = SPH_R(1);
    }
    while (f.t < end) step(&f);
    decay = exp(-2.0 * nu * k * k * f.t);
    for (i = 0; i < f.n; i++) {
        const double x = (double)f.x[i], y = (double)f.y[i], u = -cos(k * x) * sin(k * y) * decay, v = sin(k * x) * cos(k * y) * decay;
        error += hypot((double)f.vx[i] - u, (double)f.vy[i] - v) / (double)f.n;
        size += hypot(u, v) / (double)f.n;
        energy += (pow((double)f.vx[i], 2.0) + pow((double)f.vy[i], 2.0)) * 2.0 / (double)f.n;
    }
    (void)size;
    r.first = error / decay;
    r.second = energy / (decay * decay);
    r.clustered = 0.0;
    free(f.memory);
    return r;
}

int main(int argc, char **argv)
{
    const double end = argc > 1 ? atof(argv[1]) : 6.0;
    const int side = argc > 2 ? atoi(argv[2]) : 12, cells = argc > 3 ? atoi(argv[3]) : 20;
    int form, shifting, seed;
    for (form = NONE; form <= FOURTAKAS; form++) {
        answer a = tank(form, 0, side, end, 0.0, 1);
        printf("tank %d: rise %.5f p %.4f\n", form, a.first, a.second);
        fflush(stdout);
    }
    for (form = NONE; form <= ANTUONO; form += 2) {
        answer a = tank(form, 1, side, end, 0.0, 1);
        printf("tank %d shifted: rise %.5f p %.4f\n", form, a.first, a.second);
        fflush(stdout);
    }
    for (form = NONE; form <= ANTUONO; form++)
        for (shifting = 0; shifting < 2; shifting++)
            for (seed = 0; seed < 3; seed++) {
                answer a = vortices(form, shifting, 0, cells, 0.8, seed ? 0.02 : 0.0, (uint64_t)seed);
                printf("vortices %d shift %d seed %d: error %.4f energy %.4f\n", form, shifting, seed, a.first, a.second);
                fflush(stdout);
            }
    for (form = NONE; form <= ANTUONO; form += 2) {
        answer a = vortices(form, 0, 1, cells, 0.8, 0.0, 0);
        printf("vortices %d late: error %.4f energy %.4f\n", form, a.first, a.second);
        fflush(stdout);
    }
    return check_report("test_liquid_flow");
}
