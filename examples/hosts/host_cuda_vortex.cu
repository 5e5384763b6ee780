// SPDX-License-Identifier: MIT
//
// host_cuda_vortex.cu - the Orszag-Tang vortex on a GPU, which the gas never leaves: search, densities with their own
// h, rates and steps (lists.h, vortex.h), against the same by one core of the host.
//
//     nvcc -std=c++17 -O3 -I. examples/hosts/host_cuda_vortex.cu -o vortex && ./vortex
//                                                 (from the repository's root; -DSPH_SINGLE=1: in float)
//
// ./vortex SIDE STEPS takes SIDE columns of particles instead of 32, and prints what each stage costs: the paper has
// 512. Exit status 0 if the two agree, 77 if there is no GPU here.

#define SPH_CHECK 0 // a thread must not scan all particles
#include "sph.h"

#include "vortex.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

static void stop_on(cudaError_t error, const char *what)
{
    if (error == cudaSuccess) return;
    std::printf("%s: %s\n", what, cudaGetErrorString(error));
    std::exit(1);
}
template <class T> static T *on_device(const T *from, size_t count)
{
    T *to = nullptr;
    stop_on(cudaMalloc(&to, count * sizeof *to), "cudaMalloc");
    if (from) stop_on(cudaMemcpy(to, from, count * sizeof *to, cudaMemcpyHostToDevice), "cudaMemcpy");
    else stop_on(cudaMemset(to, 0, count * sizeof *to), "cudaMemset");
    return to;
}
// the time since the stage before
struct watch {
    cudaEvent_t begin, end;
    watch()
    {
        stop_on(cudaEventCreate(&begin), "cudaEventCreate");
        stop_on(cudaEventCreate(&end), "cudaEventCreate");
        stop_on(cudaEventRecord(begin), "cudaEventRecord");
    }
    double stage()
    {
        float ms = 0;
        stop_on(cudaEventRecord(end), "cudaEventRecord");
        stop_on(cudaEventSynchronize(end), "launch");
        stop_on(cudaEventElapsedTime(&ms, begin, end), "cudaEventElapsedTime");
        stop_on(cudaEventRecord(begin), "cudaEventRecord");
        return 1e6 * ms;
    }
};
// bytes per ns that the device reads and writes where it copies its memory
static double bandwidth()
{
    const size_t size = size_t(1) << 28;
    char *const from = on_device<char>(nullptr, size), *const to = on_device<char>(nullptr, size);
    double fastest = 0;
    watch w;
    for (int round = 0; round < 5; round++) {
        stop_on(cudaMemcpy(to, from, size, cudaMemcpyDeviceToDevice), "cudaMemcpy");
        fastest = std::fmax(fastest, 2.0 * double(size) / w.stage());
    }
    cudaFree(from), cudaFree(to);
    return fastest;
}

int main(int argc, char **argv)
{
    const int side = argc > 1 ? std::atoi(argv[1]) : 32, steps = argc > 2 ? std::atoi(argv[2]) : 10;
    cudaDeviceProp properties;
    int devices = 0, failed = 0;
    if (side < 16 || side > 4096 || steps < 1) return std::puts("SIDE must be 16 to 4096, and STEPS 1 or more"), 2;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0)
        return std::puts("no GPU here: compiled, not run"), 77;
    stop_on(cudaGetDeviceProperties(&properties, 0), "cudaGetDeviceProperties");
    vortex host = vortex_new(side), device = vortex_new(side);

    const cells g = cells_of(2, SPH_R(1.5) * sph_kernel_support(VORTEX_KERNEL, host.a[H * host.n]), 1);
    const int n = host.n, buckets = cells_all(g), blocks = (n + GROUP - 1) / GROUP, of_cells = (buckets + GROUP - 1) / GROUP;
    const size_t whole = size_t(n);
    sph_real *const a = on_device(device.a, whole * ARRAYS), *const number = on_device(device.number, NUMBERS);
    int *const bucket = on_device<int>(nullptr, whole), *const place = on_device<int>(nullptr, whole),
        *const member = on_device<int>(nullptr, whole), *const first = on_device<int>(nullptr, size_t(buckets) + 1),
        *const start = on_device<int>(nullptr, whole + 1), *const index = on_device<int>(nullptr, whole * VORTEX_PAIRS),
        *const bad = on_device<int>(nullptr, 1);
    watch w;
    for (int step = 0; step <= steps; step++) { // the first one is for the rates only
        if (step > 0) {
            largest<<<1, SCANNERS>>>(n, a, HASTE, number, LARGEST_HASTE);
            predict<<<blocks, GROUP>>>(n, a, number);
        }
        device.ns[STEP] += w.stage();
        reach<<<blocks, GROUP>>>(n, a);
        largest<<<1, SCANNERS>>>(n, a, RADIUS, number, LARGEST_RADIUS);
        nothing<<<of_cells, GROUP>>>(buckets, first);
        count<<<blocks, GROUP>>>(n, g, a, bucket, place, first);
        scan<<<1, SCANNERS>>>(buckets, first);
        put<<<blocks, GROUP>>>(n, bucket, place, first, member);
        order<<<of_cells, GROUP>>>(buckets, first, member);
        lengths<<<blocks, GROUP>>>(n, n, SPH_LARGER, g, a, number + LARGEST_RADIUS, first, member, start);
        scan<<<1, SCANNERS>>>(n, start);
        rows<<<blocks, GROUP>>>(n, n, SPH_LARGER, g, a, number + LARGEST_RADIUS, first, member, start, n * VORTEX_PAIRS, index);
        device.ns[LISTS] += w.stage();
        densities<<<blocks, GROUP>>>(n, a, start, index, bad);
        device.ns[DENSITIES] += w.stage();
        largest<<<1, SCANNERS>>>(n, a, FAST, number, LARGEST_FAST);
        rates<<<blocks, GROUP>>>(n, a, start, index, number, bad);
        device.ns[RATES] += w.stage();
        if (step > 0) correct<<<blocks, GROUP>>>(n, a, number);
        device.ns[STEP] += w.stage();
    }
    stop_on(cudaGetLastError(), "launch");
    stop_on(cudaMemcpy(&failed, bad, sizeof failed, cudaMemcpyDeviceToHost), "cudaMemcpy");
    stop_on(cudaMemcpy(device.a, a, whole * ARRAYS * sizeof *a, cudaMemcpyDeviceToHost), "cudaMemcpy");
    stop_on(cudaMemcpy(device.number, number, sizeof device.number, cudaMemcpyDeviceToHost), "cudaMemcpy");
    for (int *p : {bucket, place, member, first, start, index, bad}) cudaFree(p);
    cudaFree(a), cudaFree(number);
    if (failed) std::printf("%d particles have no answer on the device\n", failed);
    const int wrong = vortex_run(&host, steps) || vortex_compare(&host, &device, properties.name, steps, argc > 1 ? bandwidth() : 0);
    vortex_free(&host);
    vortex_free(&device);
    return failed || wrong;
}
