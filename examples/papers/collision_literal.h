/* SPDX-License-Identifier: MIT
 *
 * collision_literal.h - the collisions of the paper on particle clustering (Korzilius, Schilders &
 * Anthonissen, section IV) as printed, to compare with. DO NOT USE in a simulation: they sum over all pairs
 * in reach, receding ones, too, and all at once. Pairs that part are pulled back, and the energy of a
 * particle with several contacts grows without bounds (tests/test_collisions.c, clustering_box -full). In
 * sph_ops.h only approaching pairs collide: sph_collision_sequential, sph_collision_change_weighted.
 */
#ifndef COLLISION_LITERAL_H
#define COLLISION_LITERAL_H

#include <math.h>

#include "../../sph_ops.h"

/* a_i - a_j */
static inline sph_vec collision_difference(int dim, sph_vectors a, sph_index i, sph_index j)
{
    sph_vec d;
    d.x = a.x.p[(size_t)i * a.x.stride] - a.x.p[(size_t)j * a.x.stride];
    d.y = dim > 1 ? a.y.p[(size_t)i * a.y.stride] - a.y.p[(size_t)j * a.y.stride] : SPH_R(0);
    d.z = dim > 2 ? a.z.p[(size_t)i * a.z.stride] - a.z.p[(size_t)j * a.z.stride] : SPH_R(0);
    return d;
}
/* d less the nearest multiple of the length of a periodic axis */
static inline sph_real collision_nearest_image(sph_real d, sph_real length)
{
    return length > SPH_R(0) ? d - length * (sph_real)round((double)(d / length)) : d;
}
/* The sum over all pairs in reach; contacts: N of (4.22), 0: (4.20). Two walls, and pairs that coincide
   (closer than 1e-12 of the distance), exchange nothing. */
static inline void collision_sum_literal(int dim, sph_cloud cloud, sph_collision collision, sph_vectors v,
                                         sph_real contacts, sph_vector_out out)
{
    const sph_points points = cloud.points;
    const sph_vectors x = {sph_scalars_strided(points.x, points.stride),
                           sph_scalars_strided(points.y, points.stride),
                           sph_scalars_strided(points.z, points.stride)};
    const sph_scalars w = collision.inverse_mass;
    const sph_real reach2 = collision.distance * collision.distance;
    sph_index i, p;
    for (i = cloud.first; i < cloud.last; i++) {
        const size_t at = (size_t)i * (out.stride ? out.stride : 1);
        sph_real sx = SPH_R(0), sy = SPH_R(0), sz = SPH_R(0);
        for (p = cloud.list.start[i]; p < cloud.list.start[i + 1]; p++) {
            const sph_index j = cloud.list.index[p];
            const sph_vec v_ij = collision_difference(dim, v, i, j);
            sph_vec x_ij = collision_difference(dim, x, i, j);
            sph_impact c;
            sph_real factor;
            x_ij.x = collision_nearest_image(x_ij.x, points.box.x);
            if (dim > 1) x_ij.y = collision_nearest_image(x_ij.y, points.box.y);
            if (dim > 2) x_ij.z = collision_nearest_image(x_ij.z, points.box.z);
            c.w_i = w.p[(size_t)i * w.stride];
            c.w_j = w.p[(size_t)j * w.stride];
            c.vx = sph_dot(dim, v_ij, x_ij);
            c.r2 = sph_dot(dim, x_ij, x_ij);
            if (!(c.w_i + c.w_j > SPH_R(0)) || !(c.r2 < reach2) || !(c.r2 > SPH_R(1e-24) * reach2)) continue;
            factor = sph_collision_pair(collision.restitution, c);
            if (contacts > SPH_R(0))
                factor *= sph_length(dim, v_ij) / (contacts * (sph_real)sqrt((double)c.r2));
            sx += factor * x_ij.x;
            sy += factor * x_ij.y;
            sz += factor * x_ij.z;
        }
        out.x[at] = sx;
        if (dim > 1) out.y[at] = sy;
        if (dim > 2) out.z[at] = sz;
    }
}

/* (4.20) as printed: the change of velocity of each target,
       dv_i = -sum_j (1 + C_R) w_i / (w_i + w_j) (v_ij . e) e,   e = x_ij / r,   w = 1 / m. */
static inline void collision_change_literal(int dim, sph_cloud cloud, sph_collision collision, sph_vectors v,
                                            sph_vector_out change)
{
    collision_sum_literal(dim, cloud, collision, v, SPH_R(0), change);
}
/* (4.22) as printed: the same as an acceleration, each term over the contact time N r / |v_ij|; (4.20) / dt
   for N = |v_ij| dt / r. contacts: N. */
static inline void collision_acceleration_literal(int dim, sph_cloud cloud, sph_collision collision,
                                                  sph_vectors v, sph_real contacts,
                                                  sph_vector_out acceleration)
{
    collision_sum_literal(dim, cloud, collision, v, contacts, acceleration);
}

#endif
