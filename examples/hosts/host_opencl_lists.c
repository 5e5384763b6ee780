/* SPDX-License-Identifier: MIT */
/*
 * host_opencl_lists.c - neighbour lists made on an OpenCL device (lists.cl), and densities from them, against
 * those of sph.h on the host: targets that are some of the sources, a radius for each, open and periodic, in
 * one direction (gather) and in both (larger).
 *
 *     cc -O2 -I. examples/hosts/host_opencl_lists.c -o lists -lOpenCL -lm && ./lists
 *                                                 (from the repository's root; -DSPH_SINGLE=1: in float)
 *
 * ./lists N takes N^3 particles instead of 24^3, and prints what each stage costs. Exit status 0 if no entry
 * differs, 77 if there is no device (or none with doubles).
 */
#include "opencl.h"
#include "sph.h"

#include "lists.h"
#include <math.h>

typedef struct cloud {
    sph_index n, n_total;
    sph_real *x, *y, *z, *R, *h, *m, *rho; /* one behind the other */
} cloud;

static void *memory(size_t count, size_t size)
{
    void *const p = calloc(count, size);
    if (p) return p;
    puts("no memory");
    exit(1);
}
static double uniform(void)
{
    static unsigned state = 1;
    return (state = state * 1664525u + 1013904223u) / 4294967296.0;
}
/* a jittered lattice in the unit cube, shuffled, with h that differ by a fifth each way */
static cloud cloud_new(int side)
{
    const double spacing = 1.0 / side;
    sph_real **array[7];
    cloud c;
    sph_index i;
    int k;
    c.n_total = side * side * side;
    c.n = c.n_total / 8 * 7;
    array[0] = &c.x, array[1] = &c.y, array[2] = &c.z, array[3] = &c.R, array[4] = &c.h, array[5] = &c.m,
    array[6] = &c.rho;
    c.x = (sph_real *)memory(7 * (size_t)c.n_total, sizeof(sph_real));
    for (k = 1; k < 7; k++) *array[k] = c.x + k * c.n_total;
    for (i = 0; i < c.n_total; i++) {
        const sph_index a = (sph_index)((int64_t)i * 30011 % c.n_total);
        c.x[i] = SPH_R((a % side + 0.4 * uniform()) * spacing);
        c.y[i] = SPH_R((a / side % side + 0.4 * uniform()) * spacing);
        c.z[i] = SPH_R((a / side / side + 0.4 * uniform()) * spacing);
        c.h[i] = SPH_R(1.3 * spacing * (0.8 + 0.4 * uniform()));
        c.R[i] = sph_kernel_support(SPH_WENDLAND_C2, c.h[i]);
        c.m[i] = SPH_R(spacing * spacing * spacing);
    }
    return c;
}
/* Prints how the lists and densities of the device differ from the host's. Returns how many rows do. */
static int compare(cloud *c, int criterion, int periodic, int say)
{
    const sph_real length = SPH_R(periodic),
                   widest = sph_kernel_support(SPH_WENDLAND_C2, SPH_R(1.3 * 1.2 / cbrt(c->n_total)));
    const sph_points points =
        sph_points_periodic(sph_points_separate(c->n_total, c->x, c->y, c->z), length, length, length);
    const size_t size = sph_grid_workspace(3, c->n_total), starts = ((size_t)c->n + 1) * sizeof(sph_index),
                 each = (size_t)c->n_total * sizeof(sph_real);
    const size_t all = ((size_t)c->n_total + GROUP - 1) / GROUP * GROUP, some = ((size_t)c->n + GROUP - 1) / GROUP * GROUP;
    sph_query query = sph_query_of(points, criterion, sph_scalars_array(c->R), SPH_LIST_SORTED);
    sph_index *const start = (sph_index *)memory(1, starts),
                     *const start_device = (sph_index *)memory(1, starts), *index, *index_device, i;
    sph_real *const rho = (sph_real *)memory(1, each);
    void *const work = memory(1, size);
    int64_t pairs = 0;
    int k, buckets, pairs_device = 0, wrong = 0;
    double worst = 0, took[7];
    sph_cloud host;
    sph_grid grid;
    cells g;

    query.targets.n = c->n;
    if (sph_grid_build(3, points, sph_scalars_array(c->R), work, size, &grid) ||
        sph_grid_count(3, &grid, query, start, &pairs))
        return puts("grid"), 1;
    index = (sph_index *)memory((size_t)pairs + 1, sizeof *index);
    if (sph_grid_lists(3, &grid, query, start, index, pairs, &pairs)) return puts("lists"), 1;
    host = sph_cloud_of(points, (sph_list){start, index}, sph_scalars_array(c->h), sph_scalars_none());
    if (sph_density_summation(SPH_WENDLAND_C2, 3, sph_cloud_range(host, 0, c->n), sph_scalars_array(c->m),
                              sph_scalar_out_array(c->rho, 0)))
        return puts("density"), 1;

    g = cells_of(3, widest, periodic);
    buckets = cells_all(g);
    {
        const cl_int n = c->n, n_total = c->n_total;
        const cl_int capacity = INT32_MAX;
        const cl_mem x = opencl_copy(4 * each, c->x), h = opencl_copy(each, c->h), m = opencl_copy(each, c->m),
                     density_of = opencl_copy(each, 0), largest = opencl_copy(sizeof widest, &widest);
        const cl_mem bucket = opencl_copy(sizeof(int) * (size_t)n_total, 0),
                     place = opencl_copy(sizeof(int) * (size_t)n_total, 0),
                     member = opencl_copy(sizeof(int) * (size_t)n_total, 0),
                     first = opencl_copy(sizeof(int) * ((size_t)buckets + 1), 0),
                     begin = opencl_copy(starts, 0);
        const opencl_argument count[] = {ARGUMENT(n_total), ARGUMENT(g),     ARGUMENT(x),
                                         ARGUMENT(bucket),  ARGUMENT(place), ARGUMENT(first)};
        const opencl_argument scan_cells[] = {ARGUMENT(buckets), ARGUMENT(first)},
                              scan_rows[] = {ARGUMENT(n), ARGUMENT(begin)};
        const opencl_argument put[] = {ARGUMENT(n_total), ARGUMENT(bucket), ARGUMENT(place), ARGUMENT(first),
                                       ARGUMENT(member)};
        const opencl_argument order[] = {ARGUMENT(buckets), ARGUMENT(first), ARGUMENT(member)};
        const opencl_argument lengths[] = {ARGUMENT(n),     ARGUMENT(n_total), ARGUMENT(criterion),
                                           ARGUMENT(g),     ARGUMENT(x),       ARGUMENT(largest),
                                           ARGUMENT(first), ARGUMENT(member),  ARGUMENT(begin)};
        took[0] = opencl_run("count", all, GROUP, NUMBER(count), count);
        took[1] = opencl_run("scan", SCANNERS, SCANNERS, NUMBER(scan_cells), scan_cells);
        took[2] = opencl_run("put", all, GROUP, NUMBER(put), put);
        took[3] = opencl_run("order", ((size_t)buckets + GROUP - 1) / GROUP * GROUP, GROUP, NUMBER(order), order);
        took[4] = opencl_run("lengths", some, GROUP, NUMBER(lengths), lengths);
        took[4] += opencl_run("scan", SCANNERS, SCANNERS, NUMBER(scan_rows), scan_rows);
        opencl_back(begin, starts - sizeof(int), sizeof(int), &pairs_device);
        index_device = (sph_index *)memory((size_t)pairs_device + 1, sizeof *index_device);
        {
            const cl_mem entries = opencl_copy(((size_t)pairs_device + 1) * sizeof(int), 0);
            const opencl_argument rows[] = {ARGUMENT(n),      ARGUMENT(n_total), ARGUMENT(criterion), ARGUMENT(g),
                                            ARGUMENT(x),      ARGUMENT(largest), ARGUMENT(first),     ARGUMENT(member),
                                            ARGUMENT(begin),  ARGUMENT(capacity), ARGUMENT(entries)};
            const opencl_argument density[] = {ARGUMENT(n),     ARGUMENT(n_total), ARGUMENT(g),
                                               ARGUMENT(x),     ARGUMENT(begin),   ARGUMENT(entries),
                                               ARGUMENT(h),     ARGUMENT(m),       ARGUMENT(density_of)};
            took[5] = opencl_run("rows", some, GROUP, NUMBER(rows), rows);
            took[6] = opencl_run("density", some, GROUP, NUMBER(density), density);
            opencl_back(entries, 0, (size_t)pairs_device * sizeof(int), index_device);
            clReleaseMemObject(entries);
        }
        opencl_back(begin, 0, starts, start_device);
        opencl_back(density_of, 0, each, rho);
        {
            const cl_mem used[] = {x, h, m, density_of, largest, bucket, place, member, first, begin};
            for (k = 0; k < NUMBER(used); k++) clReleaseMemObject(used[k]);
        }
    }
    if (sph_list_sort(c->n, c->n_total, start_device, index_device, 0)) return puts("rows that are none"), 1;
    for (i = 0; i < c->n; i++) {
        const sph_index length_of = start[i + 1] - start[i];
        sph_index p = 0;
        if (start_device[i + 1] - start_device[i] == length_of)
            while (p < length_of && index[start[i] + p] == index_device[start_device[i] + p]) p++;
        else p = -1;
        wrong += p != length_of;
        worst = fmax(worst, fabs((double)rho[i] / (double)c->rho[i] - 1.0));
    }
    printf("%s, %s: %lld pairs, on the device %d; rows that differ: %d; density differs by %.1e at most\n",
           periodic ? "periodic" : "open", criterion == SPH_GATHER ? "gather" : "larger", (long long)pairs,
           pairs_device, wrong, worst);
    if (say)
        printf("  ns per particle: count %.1f, scan %.1f, put %.1f, order %.1f, lengths %.1f, rows %.1f, "
               "density %.1f\n",
               took[0] / c->n_total, took[1] / c->n_total, took[2] / c->n_total, took[3] / c->n_total,
               took[4] / c->n, took[5] / c->n, took[6] / c->n);
    free(start), free(start_device), free(index), free(index_device), free(rho), free(work);
    return wrong + !(worst < (SPH_SINGLE ? 1e-5 : 1e-13));
}

int main(int argc, char **argv)
{
    const int side = argc > 1 ? atoi(argv[1]) : 24;
    cloud c;
    int wrong = 0, periodic;
    if (side < 8 || side > 200) return puts("N, the number of particles along a side, must be 8 to 200"), 2;
    opencl_begin("examples/hosts/lists.cl", "CL1.2", SPH_SINGLE);
    c = cloud_new(side);
    printf("%s, %s: %d targets of %d sources\n", opencl.name, SPH_SINGLE ? "float" : "double", (int)c.n,
           (int)c.n_total);
    for (periodic = 0; periodic < 2; periodic++) {
        wrong += compare(&c, SPH_GATHER, periodic, argc > 1);
        wrong += compare(&c, SPH_LARGER, periodic, argc > 1);
    }
    free(c.x);
    return wrong != 0;
}
