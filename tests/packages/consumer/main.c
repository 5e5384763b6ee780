/* SPDX-License-Identifier: MIT */
/* A host that got sph.h as a package: the density of a line of particles of mass 0.1 and distance 0.1, which is 1 in the middle. */
#include <sph.h>
#include <stdio.h>

enum { N = 41 };

int main(void)
{
    double x[N], rho[N];
    const double h = 0.15, m = 0.1, radius = sph_kernel_support_ratio(SPH_WENDLAND_C4_1D) * h;
    static char work[20000];
    sph_index start[N + 1], index[8 * N];
    int64_t pairs;
    sph_grid grid;
    int i;
    for (i = 0; i < N; i++) x[i] = 0.1 * i;
    {
        const sph_points points = sph_points_separate(N, x, NULL, NULL);
        const sph_scalars R = sph_scalars_same(&radius);
        const sph_list list = {start, index};
        const sph_cloud all = sph_cloud_of(points, list, sph_scalars_same(&h), sph_scalars_none());
        if (sizeof work < sph_grid_workspace(1, N) || sph_grid_build(1, points, R, work, sizeof work, &grid) ||
            sph_grid_lists(1, &grid, sph_query_of(points, SPH_GATHER, R, 0), start, index, 8 * N, &pairs))
            return 1;
        if (sph_density_summation(SPH_WENDLAND_C4_1D, 1, all, sph_scalars_same(&m), sph_scalar_out_array(rho, 0))) return 1;
    }
    printf("sph.h %d.%d.%d: density %.4f\n", SPH_VERSION_MAJOR, SPH_VERSION_MINOR, SPH_VERSION_PATCH, rho[N / 2]);
    return rho[N / 2] < 0.99 || rho[N / 2] > 1.01;
}
