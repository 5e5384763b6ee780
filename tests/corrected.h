/* SPDX-License-Identifier: MIT
 *
 * corrected.h - a flow with room for what corrects its kernels: A, B and their gradients, and C of IAD.
 *
 *     corrected r = corrected_of(flow_of(cloud_lattice(2, 11, 1.8, 0.3, 3), 17));      takes the flow
 *     sph_rk_correction(KERNEL, 2, view(&r, 1), out_of(&r));
 *     ... rk_of(&r), inverse_of(&r), rates_out(&r) ...
 *     corrected_free(&r);
 *
 * Include it after flows.h.
 */
#ifndef CORRECTED_H
#define CORRECTED_H

typedef struct corrected {
    flow f;
    sph_real *memory, *scale, *slope[3], *dscale[3], *dslope, *inverse, *conditioning;
    unsigned char *status;
} corrected;

static inline corrected corrected_of(flow f)
{
    corrected r;
    const size_t n = (size_t)f.c.n;
    int a;
    r.f = f;
    r.memory = (sph_real *)cloud_memory(26 * n, sizeof *r.memory);
    r.scale = r.memory;
    for (a = 0; a < 3; a++) {
        r.slope[a] = r.memory + (size_t)(1 + a) * n;
        r.dscale[a] = r.memory + (size_t)(4 + a) * n;
    }
    r.dslope = r.memory + 7 * n;
    r.inverse = r.memory + 16 * n;
    r.conditioning = r.memory + 25 * n;
    r.status = (unsigned char *)cloud_memory(n, 1);
    return r;
}
static inline void corrected_free(corrected *r)
{
    flow_free(&r->f);
    free(r->memory);
    free(r->status);
}
static inline sph_cloud view(const corrected *r, int own)
{
    const flow *f = &r->f;
    return sph_cloud_of(cloud_points(&f->c), cloud_list(&f->c), own ? sph_scalars_array(f->h) : cloud_h(&f->c), cloud_V(&f->c));
}
static inline sph_rk_out out_of(const corrected *r)
{
    sph_rk_out o;
    memset(&o, 0, sizeof o);
    o.scale = r->scale;
    o.conditioning = r->conditioning;
    o.slope = sph_vector_out_separate(r->slope[0], r->slope[1], r->slope[2]);
    o.scale_gradient = sph_vector_out_separate(r->dscale[0], r->dscale[1], r->dscale[2]);
    o.slope_gradient = sph_matrix_out_packed(r->f.c.dim, r->dslope);
    o.status = r->status;
    return o;
}
static inline sph_rk rk_of(const corrected *r)
{
    sph_rk k;
    k.scale = sph_scalars_array(r->scale);
    k.slope = sph_vectors_separate(r->slope[0], r->slope[1], r->slope[2]);
    k.scale_gradient = sph_vectors_separate(r->dscale[0], r->dscale[1], r->dscale[2]);
    k.slope_gradient = sph_matrices_packed(r->f.c.dim, r->dslope);
    return k;
}
static inline sph_matrices inverse_of(const corrected *r) { return sph_matrices_packed(r->f.c.dim, r->inverse); }
static inline sph_correction_out iad_out(const corrected *r)
{
    sph_correction_out o;
    memset(&o, 0, sizeof o);
    o.inverse = sph_matrix_out_packed(r->f.c.dim, r->inverse);
    return o;
}
static inline sph_corrected_out rates_out(const corrected *r)
{
    sph_corrected_out o;
    memset(&o, 0, sizeof o);
    o.acceleration = flow_a(&r->f);
    o.rate_u = r->f.heating;
    return o;
}
static inline sph_rk_side side_of(const corrected *r, sph_index i)
{
    const sph_rk k = rk_of(r);
    return sphi_rk_side(r->f.c.dim, &k, i);
}

#endif
