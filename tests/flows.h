/* SPDX-License-Identifier: MIT
 *
 * flows.h - a cloud with the state of a fluid, by random numbers, that the tests of fluids share.
 *
 *     flow f = flow_of(cloud_lattice(2, 11, 1.4, 0.2, 1), 17);      takes the cloud
 *     ... flow_cloud(&f, cloud_h(&f.c)), flow_fluid(&f), flow_a(&f) ...
 *     flow_free(&f);
 *
 * Include it after clouds.h.
 */
#ifndef FLOWS_H
#define FLOWS_H

#include <string.h>

typedef struct flow {
    cloud c;
    sph_real *m, *rho, *p, *cs, *v[3], *a[3], *rate, *heating;
    sph_real *h; /* of each particle: 0.775 to 1 times that of the cloud */
} flow;

static inline flow flow_of(cloud c, uint64_t seed)
{
    flow f;
    pcg32 g;
    sph_index i;
    int k;
    f.c = c;
    f.m = (sph_real *)cloud_memory(13 * (size_t)c.n, sizeof *f.m);
    f.rho = f.m + c.n;
    f.p = f.rho + c.n;
    f.cs = f.p + c.n;
    f.h = f.cs + c.n;
    f.rate = f.h + c.n;
    f.heating = f.rate + c.n;
    for (k = 0; k < 3; k++) {
        f.v[k] = f.heating + (k + 1) * c.n;
        f.a[k] = f.heating + (k + 4) * c.n;
    }
    pcg32_seed(&g, seed, 5);
    for (i = 0; i < c.n; i++) {
        f.m[i] = SPH_R(pow(c.dx, c.dim) * (1.0 + 0.8 * cloud_symmetric(&g)));
        f.rho[i] = SPH_R(1.0 + 0.8 * cloud_symmetric(&g));
        f.p[i] = SPH_R(cloud_symmetric(&g));
        f.cs[i] = SPH_R(2.0 + cloud_symmetric(&g));
        f.h[i] = c.h * SPH_R(1.0 - 0.3 * (i % 4) / 4.0);
        for (k = 0; k < 3; k++) f.v[k][i] = SPH_R(k < c.dim ? cloud_symmetric(&g) : 0.0);
    }
    return f;
}
static inline void flow_free(flow *f)
{
    cloud_free(&f->c);
    free(f->m);
}
static inline sph_vectors flow_v(const flow *f) { return sph_vectors_separate(f->v[0], f->v[1], f->v[2]); }
static inline sph_vector_out flow_a(const flow *f)
{
    return sph_vector_out_separate(f->a[0], f->a[1], f->a[2]);
}
static inline sph_cloud flow_cloud(const flow *f, sph_scalars h)
{
    return sph_cloud_of(cloud_points(&f->c), cloud_list(&f->c), h, sph_scalars_none());
}
/* without artificial viscosity */
static inline sph_fluid flow_fluid(const flow *f)
{
    sph_fluid s;
    memset(&s, 0, sizeof s);
    s.m = sph_scalars_array(f->m);
    s.rho = sph_scalars_array(f->rho);
    s.p = sph_scalars_array(f->p);
    s.c = sph_scalars_array(f->cs);
    s.v = flow_v(f);
    return s;
}

#endif
