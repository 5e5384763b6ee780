/* SPDX-License-Identifier: MIT
 *
 * host_opencl_vortex.c - the Orszag-Tang vortex on an OpenCL device, which the gas never leaves: search, densities
 * with their own h, rates and steps (vortex.h), against the same on the host.
 *
 *     cc -O2 -I. examples/hosts/host_opencl_vortex.c -o vortex -lOpenCL -lm && ./vortex
 *                                                 (from the repository's root; -DSPH_SINGLE=1: in float)
 *
 * ./vortex SIDE STEPS takes SIDE columns of particles instead of 32, and prints what each stage costs: the paper has
 * 512. Exit status 0 if the two agree, 77 if there is no device (or none with doubles).
 */
#define SPH_CHECK 0
#include "opencl.h"
#include "sph.h"

#include "vortex.h"

int main(int argc, char **argv)
{
    const int side = argc > 1 ? atoi(argv[1]) : 32, steps = argc > 2 ? atoi(argv[2]) : 10;
    vortex host, device;
    int step, failed = 0, wrong;
    if (side < 16 || side > 4096 || steps < 1) return puts("SIDE must be 16 to 4096, and STEPS 1 or more"), 2;
    opencl_begin("examples/hosts/vortex.cl", "CL1.2", SPH_SINGLE);
    host = vortex_new(side);
    device = vortex_new(side);
    {
        const cells g = cells_of(2, SPH_R(1.5) * sph_kernel_support(VORTEX_KERNEL, host.a[H * host.n]), 1);
        const cl_int n = host.n, buckets = cells_all(g), criterion = SPH_LARGER, capacity = n * VORTEX_PAIRS;
        const size_t items = ((size_t)n + GROUP - 1) / GROUP * GROUP, of_cells = ((size_t)buckets + GROUP - 1) / GROUP * GROUP;
        const size_t numbers = (size_t)n * ARRAYS * sizeof(sph_real), whole = (size_t)n * sizeof(cl_int);
        const cl_int radius = RADIUS, fast = FAST, haste = HASTE, to_radius = LARGEST_RADIUS, to_fast = LARGEST_FAST,
                     to_haste = LARGEST_HASTE;
        const cl_mem a = opencl_copy(numbers, device.a), number = opencl_copy(sizeof device.number, device.number),
                     bucket = opencl_copy(whole, 0), place = opencl_copy(whole, 0), member = opencl_copy(whole, 0),
                     first = opencl_copy(((size_t)buckets + 1) * sizeof(cl_int), 0), start = opencl_copy(whole + sizeof(cl_int), 0),
                     index = opencl_copy(whole * VORTEX_PAIRS, 0), bad = opencl_copy(sizeof(cl_int), 0);
        const opencl_argument predict[] = {ARGUMENT(n), ARGUMENT(a), ARGUMENT(number)}, reach[] = {ARGUMENT(n), ARGUMENT(a)};
        const opencl_argument of_radius[] = {ARGUMENT(n), ARGUMENT(a), ARGUMENT(radius), ARGUMENT(number), ARGUMENT(to_radius)};
        const opencl_argument of_fast[] = {ARGUMENT(n), ARGUMENT(a), ARGUMENT(fast), ARGUMENT(number), ARGUMENT(to_fast)};
        const opencl_argument of_haste[] = {ARGUMENT(n), ARGUMENT(a), ARGUMENT(haste), ARGUMENT(number), ARGUMENT(to_haste)};
        const opencl_argument nothing[] = {ARGUMENT(buckets), ARGUMENT(first)};
        const opencl_argument count[] = {ARGUMENT(n), ARGUMENT(g), ARGUMENT(a), ARGUMENT(bucket), ARGUMENT(place), ARGUMENT(first)};
        const opencl_argument put[] = {ARGUMENT(n), ARGUMENT(bucket), ARGUMENT(place), ARGUMENT(first), ARGUMENT(member)};
        const opencl_argument order[] = {ARGUMENT(buckets), ARGUMENT(first), ARGUMENT(member)};
        const opencl_argument lengths[] = {ARGUMENT(n),      ARGUMENT(n),     ARGUMENT(criterion), ARGUMENT(g),    ARGUMENT(a),
                                           ARGUMENT(number), ARGUMENT(first), ARGUMENT(member),    ARGUMENT(start)};
        const opencl_argument scan_rows[] = {ARGUMENT(n), ARGUMENT(start)};
        const opencl_argument rows[] = {ARGUMENT(n),      ARGUMENT(n),     ARGUMENT(criterion), ARGUMENT(g),     ARGUMENT(a),       ARGUMENT(number),
                                        ARGUMENT(first),  ARGUMENT(member), ARGUMENT(start),    ARGUMENT(capacity), ARGUMENT(index)};
        const opencl_argument densities[] = {ARGUMENT(n), ARGUMENT(a), ARGUMENT(start), ARGUMENT(index), ARGUMENT(bad)};
        const opencl_argument rates[] = {ARGUMENT(n), ARGUMENT(a), ARGUMENT(start), ARGUMENT(index), ARGUMENT(number), ARGUMENT(bad)};
        double *const ns = device.ns;
        for (step = 0; step <= steps; step++) { /* the first one is for the rates only */
            if (step > 0) {
                ns[STEP] += opencl_run("largest", SCANNERS, SCANNERS, NUMBER(of_haste), of_haste);
                ns[STEP] += opencl_run("predict", items, GROUP, NUMBER(predict), predict);
            }
            ns[LISTS] += opencl_run("reach", items, GROUP, NUMBER(reach), reach);
            ns[LISTS] += opencl_run("largest", SCANNERS, SCANNERS, NUMBER(of_radius), of_radius);
            ns[LISTS] += opencl_run("nothing", of_cells, GROUP, NUMBER(nothing), nothing);
            ns[LISTS] += opencl_run("count", items, GROUP, NUMBER(count), count);
            ns[LISTS] += opencl_run("scan", SCANNERS, SCANNERS, NUMBER(nothing), nothing);
            ns[LISTS] += opencl_run("put", items, GROUP, NUMBER(put), put);
            ns[LISTS] += opencl_run("order", of_cells, GROUP, NUMBER(order), order);
            ns[LISTS] += opencl_run("lengths", items, GROUP, NUMBER(lengths), lengths);
            ns[LISTS] += opencl_run("scan", SCANNERS, SCANNERS, NUMBER(scan_rows), scan_rows);
            ns[LISTS] += opencl_run("rows", items, GROUP, NUMBER(rows), rows);
            ns[DENSITIES] += opencl_run("densities", items, GROUP, NUMBER(densities), densities);
            ns[RATES] += opencl_run("largest", SCANNERS, SCANNERS, NUMBER(of_fast), of_fast);
            ns[RATES] += opencl_run("rates", items, GROUP, NUMBER(rates), rates);
            if (step > 0) ns[STEP] += opencl_run("correct", items, GROUP, NUMBER(predict), predict);
        }
        opencl_back(bad, 0, sizeof failed, &failed);
        opencl_back(a, 0, numbers, device.a);
        opencl_back(number, 0, sizeof device.number, device.number);
        {
            const cl_mem used[] = {a, number, bucket, place, member, first, start, index, bad};
            int k;
            for (k = 0; k < NUMBER(used); k++) clReleaseMemObject(used[k]);
        }
    }
    if (failed) printf("%d particles have no answer on the device\n", failed);
    wrong = vortex_run(&host, steps) || vortex_compare(&host, &device, opencl.name, steps, argc > 1 ? opencl_bandwidth() : 0);
    vortex_free(&host);
    vortex_free(&device);
    return failed || wrong;
}
