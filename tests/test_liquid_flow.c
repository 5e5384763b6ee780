/* SPDX-License-Identifier: MIT */
/*
 * test_liquid_flow.c - what density diffusion and shifting do to a flow, good and bad: a tank at rest, and Taylor-Green vortices.
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
    double speed; /* that shifting takes for the largest of the flow; 0: the largest of the moment */
    int periodic, form, shifting, late; /* late: rates by the old velocities, the wrong order */
    sph_real *x, *y, *vx, *vy, *ax, *ay, *sx, *sy, *rho, *p, *m, *V, *rate, *share, *gx, *gy, *kx, *ky, *lx, *ly, *eigenvalue, *nx, *ny, *c0, *mu, *memory;
} flow;
enum { ARRAYS = 25 };

static flow flow_new(sph_index n)
{
    flow f;
    sph_real **const a[ARRAYS] = {&f.x, &f.y, &f.vx, &f.vy, &f.ax, &f.ay, &f.sx, &f.sy, &f.rho, &f.p, &f.m, &f.V, &f.rate,
                                  &f.share, &f.gx, &f.gy, &f.kx, &f.ky, &f.lx, &f.ly, &f.eigenvalue, &f.nx, &f.ny, &f.c0, &f.mu};
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
static int step(flow *f, double *noise) /* 0: it has blown up. noise, if not null: rms of p less its mean over the neighbours, before the step */
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
    for (i = 0; i < f->wet; i++)
        if (!(hypot((double)f->vx[i], (double)f->vy[i]) < 10.0)) {
            free(memory);
            return 0;
        }
    if (sph_search(2, f->points, sph_scalars_same(&reach), SPH_GATHER, memory, size, &found) != 0) abort();
    for (i = 0; i < f->n; i++) f->V[i] = f->m[i] / f->rho[i];
    all = sph_cloud_of(f->points, found.list, sph_scalars_same(&h), sph_scalars_array(f->V));
    wet = sph_cloud_range(all, 0, f->wet);
    s.m = sph_scalars_array(f->m);
    s.rho = sph_scalars_array(f->rho);
    s.p = sph_scalars_array(f->p);
    s.c = sph_scalars_array(f->c0);
    s.v = two(f->vx, f->vy);
    if (noise) {
        CHECK(sph_interpolate_shepard(KERNEL, 2, wet, s.p, sph_scalar_out_array(f->sx, 0)) == 0);
        for (*noise = 0.0, i = 0; i < f->wet; i++) *noise += pow((double)f->p[i] - (double)f->sx[i], 2.0) / (double)f->wet;
        *noise = sqrt(*noise);
    }
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
    d.fluid = s;
#define RATES \
    (f->form == ANTUONO     ? sph_density_diffusion_antuono(KERNEL, 2, wet, d, sph_scalar_out_array(f->rate, 0)) \
     : f->form == FOURTAKAS ? sph_density_diffusion_fourtakas(KERNEL, 2, wet, d, sph_scalar_out_array(f->rate, 0)) \
                            : sph_density_diffusion_molteni(KERNEL, 2, wet, d, sph_scalar_out_array(f->rate, 0)))
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
        double fastest = f->speed;
        sph_real strength;
        sph_shift shift = {0};
        for (i = 0; i < f->wet && !(f->speed > 0.0); i++) fastest = fmax(fastest, hypot((double)f->vx[i], (double)f->vy[i]));
        strength = sph_shift_strength_sun(h, SPH_R(fastest * f->dt), SPH_R(2.0 * f->dx));
        shift.strength = sph_scalars_same(&strength);
        shift.tensile = SPH_R(0.2);
        shift.spacing = SPH_R(f->dx / f->h);
        if (!f->periodic) {
            CHECK(sph_free_surface(KERNEL, 2, all, (sph_surface_out){.eigenvalue = f->eigenvalue, .normal = to(f->nx, f->ny)}) >= 0);
            shift.eigenvalue = sph_scalars_array(f->eigenvalue);
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
    return 1;
}

/* ---- a tank at rest: how far the centre of mass rises, in parts of the depth, and how far the pressure is off, rms, in parts of rho g depth ---- */

typedef struct answer {
    double rise, p;                /* of a tank */
    double error, energy, noise; /* of vortices */
} answer;
static answer tank(int form, int shifting, double speed)
{
    enum { LAYERS = 4, side = 10 };
    const double dx = 1.0 / side, end = 6.0;
    const sph_index wet = (sph_index)(side * side), most = wet + (sph_index)((side + 2 * LAYERS) * (side + LAYERS + side / 2));
    const sph_tait state = {.rho0 = SPH_R(1), .c = SPH_R(20), .gamma = SPH_R(7)};
    flow f = flow_new(most);
    double start = 0.0, y = 0.0, error = 0.0;
    sph_index i, n = 0;
    int a, b, wall;
    answer r = {0};
    for (wall = 0; wall < 2; wall++)
        for (a = -LAYERS; a < side + LAYERS; a++)
            for (b = -LAYERS; b < side + side / 2; b++) {
                const int inside = a >= 0 && a < side && b >= 0;
                if (inside && b >= side) continue;
                if (inside == wall) continue;
                f.x[n] = SPH_R((a + 0.5) * dx);
                f.y[n] = SPH_R((b + 0.5) * dx);
                f.p[n] = SPH_R(wall ? 0.0 : 1.0 - (double)f.y[n]);
                f.share[n] = SPH_R(!wall);
                n++;
            }
    f.n = n;
    f.wet = wet;
    f.dx = dx;
    f.h = 1.6 * dx;
    f.c = 20.0;
    f.speed = speed;
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
    while (f.t < end && step(&f, 0)) {}
    CHECK(f.t >= end);
    for (i = 0; i < wet; i++) {
        y += (double)f.y[i] / wet;
        error += pow((double)f.p[i] - (1.0 - (double)f.y[i]), 2.0) / wet;
    }
    r.rise = y - start;
    r.p = sqrt(error);
    free(f.memory);
    return r;
}

/* ---- Taylor-Green vortices, Re 100, from a lattice: mean error of the velocity over the exact amplitude, the energy over that of the start, the noise of the pressure ---- */

static answer vortices(int form, int shifting, int late, uint64_t seed)
{
    enum { side = 20 };
    const double dx = 1.0 / side, end = 0.8, jitter = 0.02, nu = 0.01, k = 2.0 * PI;
    flow f = flow_new((sph_index)(side * side));
    double decay, error = 0.0, energy = 0.0;
    pcg32 g;
    sph_index i;
    answer r = {0};
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
    while (f.t < end && step(&f, &r.noise)) {}
    decay = exp(-2.0 * nu * k * k * f.t);
    for (i = 0; i < f.n; i++) {
        const double x = (double)f.x[i], y = (double)f.y[i], u = -cos(k * x) * sin(k * y) * decay, v = sin(k * x) * cos(k * y) * decay;
        error += hypot((double)f.vx[i] - u, (double)f.vy[i] - v) / (double)f.n;
        energy += (pow((double)f.vx[i], 2.0) + pow((double)f.vy[i], 2.0)) * 2.0 / (double)f.n;
    }
    r.error = error / decay;
    r.energy = energy;
    free(f.memory);
    return r;
}

static void test_tank(void)
{
    const answer none = tank(NONE, 0, 0.0), molteni = tank(MOLTENI, 0, 0.0), antuono = tank(ANTUONO, 0, 0.0), fourtakas = tank(FOURTAKAS, 0, 0.0);
    answer shifted;
    CHECK_WORST("rise without diffusion", none.rise, 5e-4);
    CHECK_WORST("rise with antuono", antuono.rise, 5e-4);
    CHECK_WORST("rise with fourtakas", fourtakas.rise, 5e-4);
    CHECK(molteni.rise < -3e-3 && molteni.rise > -1.2e-2); /* it takes the weight of the column for noise, and the column sinks */
    CHECK(antuono.p < 0.7 * molteni.p && fourtakas.p < 0.7 * molteni.p);
    CHECK(antuono.p < 0.9 * none.p);
    shifted = tank(ANTUONO, 1, 2.0); /* what shifting costs: the liquid swells. Nobody should claim otherwise */
    CHECK(shifted.rise > 5e-3 && shifted.rise < 2e-2);
    shifted = tank(ANTUONO, 1, 0.0); /* by the speed of the moment, which is nearly 0 here, it does not */
    CHECK_WORST("rise with a shift by the speed of the moment", shifted.rise, 2e-3);
}
/* Over seeds 0 to 2:            error            energy         noise
       nothing              0.255 ... 0.287   0.105 ... 0.120   0.32 ... 0.41
       antuono              0.210 ... 0.221   0.133 ... 0.137   0.046 ... 0.055
       antuono, shifted     0.027 ... 0.028   0.279 ... 0.280   0.038 ... 0.045
   and the exact energy is 0.282. What differs less than that between two schemes is chance. */
static void test_vortices(void)
{
    int seed;
    for (seed = 0; seed < 3; seed++) {
        const answer none = vortices(NONE, 0, 0, (uint64_t)seed), smooth = vortices(ANTUONO, 0, 0, (uint64_t)seed), even = vortices(ANTUONO, 1, 0, (uint64_t)seed);
        CHECK(none.error > 0.2 && smooth.error > 0.15);
        CHECK(smooth.noise < 0.2 * none.noise);
        CHECK(even.error < 0.05);
        CHECK(even.noise < 0.2 * none.noise);
        CHECK_RELATIVE(even.energy, 0.282, 0.03);
    }
    {
        const answer molteni = vortices(MOLTENI, 0, 0, 1), shifted = vortices(NONE, 1, 0, 1), late = vortices(ANTUONO, 0, 1, 1);
        CHECK(molteni.noise < 0.07 && molteni.error > 0.15); /* smooth, but not even */
        CHECK(shifted.error < 0.06 && shifted.noise > 0.2);  /* even, but not smooth */
        CHECK(late.energy > 4.0);                            /* rates by the old velocities: no diffusion cures that */
    }
}

int main(void)
{
    test_tank();
    test_vortices();
    return check_report("test_liquid_flow");
}
