// SPDX-License-Identifier: MIT
//
// bench_gpu.cu - sweeps on a GPU, one thread a particle, beside the same calls by one core of the host, on a jittered cubic lattice in three dimensions (h = 1.2 dx, cubic spline, 57 neighbours).
//
//     make bench-gpu                                   in double and in float; or, from the repository's root:
//     nvcc -std=c++17 -O3 -I. tests/bench/bench_gpu.cu -o bench_gpu && ./bench_gpu [side of the lattice: 100]
//
// Times are the shortest of ROUNDS; lists are made on the host and not timed. Exit status 0 if all answers agree, 77 if there is no GPU here.

#define SPH_CHECK 0 // a thread must not scan all particles
#include "sph.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

constexpr int DIM = 3, ROUNDS = 10, THREADS = 128;
constexpr sph_kernel KERNEL = SPH_CUBIC_SPLINE;
enum field { X, Y, Z, M, V, RHO, OMEGA, P, U, CS, ALPHA, PSI, VX, VY, VZ, BX, BY, BZ, OUT, FIELDS = OUT + 11 };
enum sweep { DENSITY, GRADIENT, MSPH, MHD, SWEEPS };
static const char *const name[SWEEPS] = {"density", "corrected gradient", "M-SPH Laplacian", "all of SPMHD"};

// the cloud in the memory of one machine or the other; h: one for all
struct cloud {
    sph_index n;
    sph_real *a[FIELDS], *h;
    sph_index *start, *index;
};

SPH_FN sph_vectors vectors(const cloud &c, int first)
{
    return sph_vectors_separate(c.a[first], c.a[first + 1], c.a[first + 2]);
}
SPH_FN sph_vector_out into(const cloud &c, int first)
{
    return sph_vector_out_separate(c.a[first], c.a[first + 1], c.a[first + 2]);
}
// the sweep over a range of targets: a thread's one, or all of them
SPH_FN sph_index range(int what, const cloud &c, sph_index first, sph_index last)
{
    const sph_points x = sph_points_separate(c.n, c.a[X], c.a[Y], c.a[Z]);
    const sph_scalars m = sph_scalars_array(c.a[M]), u = sph_scalars_array(c.a[U]);
    const sph_list list = {c.start, c.index};
    const sph_cloud all = sph_cloud_of(x, list, sph_scalars_same(c.h), sph_scalars_array(c.a[V]));
    const sph_cloud targets = sph_cloud_range(all, first, last);
    switch (what) {
    case DENSITY: return sph_density_summation(KERNEL, DIM, targets, m, sph_scalar_out_array(c.a[OUT], 0));
    case GRADIENT: {
        sph_derivatives_out g{};
        g.gx = c.a[OUT];
        g.gy = c.a[OUT + 1];
        g.gz = c.a[OUT + 2];
        return sph_gradient_cspm(KERNEL, DIM, targets, u, g);
    }
    case MSPH:
        return sph_elliptic_msph(KERNEL, DIM, targets, sph_scalars_array(c.a[RHO]), (sph_elliptic_options){0},
                                 u, sph_scalar_out_array(c.a[OUT], nullptr));
    default: {
        sph_mhd s;
        sph_mhd_out o;
        s.medium.m = m;
        s.medium.rho = sph_scalars_array(c.a[RHO]);
        s.medium.omega = sph_scalars_array(c.a[OMEGA]);
        s.p = sph_scalars_array(c.a[P]);
        s.u = u;
        s.cs = sph_scalars_array(c.a[CS]);
        s.alpha = s.alpha_B = sph_scalars_array(c.a[ALPHA]);
        s.v = vectors(c, VX);
        s.field = vectors(c, BX);
        s.psi = sph_scalars_array(c.a[PSI]);
        s.ch = s.alpha_u = s.tensile = s.sigma = SPH_R(1);
        s.beta = SPH_R(2);
        o.acceleration = into(c, OUT);
        o.rate_B = into(c, OUT + 3);
        o.rate_u = c.a[OUT + 6];
        o.rate_psi = c.a[OUT + 7];
        o.div_B = c.a[OUT + 8];
        o.div_v = c.a[OUT + 9];
        o.v_sig = c.a[OUT + 10];
        return sph_mhd_rates(KERNEL, DIM, targets, s, o);
    }
    }
}
template <int what> __global__ void on_device(cloud c)
{
    const sph_index i = sph_index(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < c.n) range(what, c, i, i + 1);
}

static void stop_on(cudaError_t error, const char *what)
{
    if (error == cudaSuccess) return;
    std::printf("%s: %s\n", what, cudaGetErrorString(error));
    std::exit(1);
}
template <class T> static T *to_device(const T *from, size_t count)
{
    T *to = nullptr;
    stop_on(cudaMalloc(&to, count * sizeof *to), "cudaMalloc");
    stop_on(cudaMemcpy(to, from, count * sizeof *to, cudaMemcpyHostToDevice), "cudaMemcpy");
    return to;
}

// Prints a line; 1 if the two machines disagree
template <int what> static int compare(const cloud &host, const cloud &device)
{
    const int outputs = what == MHD ? 11 : what == GRADIENT ? 3 : 1;
    double fastest = HUGE_VAL, seconds, worst = 0;
    std::vector<sph_real> back((size_t)host.n);
    cudaEvent_t begin, end;
    cudaEventCreate(&begin);
    cudaEventCreate(&end);
    for (int round = 0; round < ROUNDS; round++) {
        float ms = 0;
        cudaEventRecord(begin);
        on_device<what><<<(host.n + THREADS - 1) / THREADS, THREADS>>>(device);
        cudaEventRecord(end);
        stop_on(cudaEventSynchronize(end), name[what]);
        cudaEventElapsedTime(&ms, begin, end);
        fastest = std::fmin(fastest, 1e-3 * ms);
    }
    const auto start = std::chrono::steady_clock::now();
    if (range(what, host, 0, host.n) != 0) return std::printf("%s: the host has no answer\n", name[what]), 1;
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (int k = 0; k < outputs; k++) {
        double size = 0, off = 0;
        stop_on(cudaMemcpy(back.data(), device.a[OUT + k], (size_t)host.n * sizeof(sph_real), cudaMemcpyDeviceToHost), "cudaMemcpy");
        for (sph_index i = 0; i < host.n; i++) {
            size = std::fmax(size, std::fabs((double)host.a[OUT + k][i]));
            off = std::fmax(off, std::fabs((double)host.a[OUT + k][i] - (double)back[(size_t)i]));
        }
        worst = std::fmax(worst, off / size);
    }
    std::printf("%-20s %12.3f %12.1f %10.0f %16.1e\n", name[what], 1e9 * fastest / host.n, 1e9 * seconds / host.n, seconds / fastest, worst);
    return !(worst < 2000 * (double)SPH_EPSILON);
}

int main(int argc, char **argv)
{
    const int side = argc > 1 ? std::atoi(argv[1]) : 100;
    int devices = 0;
    cudaDeviceProp properties;
    if (side < 8 || side > 400) return std::printf("usage: bench_gpu [side of the lattice, 8 to 400]\n"), 2;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) return std::puts("no GPU here"), 77;
    stop_on(cudaGetDeviceProperties(&properties, 0), "cudaGetDeviceProperties");

    const sph_index n = side * side * side;
    const double dx = 1.0 / side;
    sph_real h = SPH_R(1.2 * dx), radius = h * sph_kernel_support_ratio(KERNEL);
    std::vector<sph_real> data((size_t)FIELDS * (size_t)n);
    std::vector<sph_index> start((size_t)n + 1), index(80 * (size_t)n);
    std::vector<char> work(sph_grid_workspace(DIM, n));
    cloud host, device;
    sph_grid grid;
    int64_t pairs;
    host.n = n;
    host.h = &h;
    host.start = start.data();
    host.index = index.data();
    for (int k = 0; k < FIELDS; k++) host.a[k] = data.data() + (size_t)k * (size_t)n;
    for (sph_index i = 0; i < n; i++) {
        host.a[X][i] = SPH_R(dx * (i % side + 0.5 + 0.2 * std::sin(37.0 * i)));
        host.a[Y][i] = SPH_R(dx * (i / side % side + 0.5 + 0.2 * std::cos(53.0 * i)));
        host.a[Z][i] = SPH_R(dx * (i / side / side + 0.5 + 0.2 * std::sin(71.0 * i)));
        host.a[M][i] = host.a[V][i] = SPH_R(dx * dx * dx);
        for (int k = RHO; k < OUT; k++) host.a[k][i] = SPH_R(1 + 0.1 * std::sin(k + 13.0 * i));
    }
    const sph_scalars R = sph_scalars_same(&radius);
    const sph_points x = sph_points_separate(n, host.a[X], host.a[Y], host.a[Z]);
    if (sph_grid_build(DIM, x, R, work.data(), work.size(), &grid) != 0 ||
        sph_grid_lists(DIM, &grid, sph_query_of(x, SPH_GATHER, R, 0), host.start, host.index, (int64_t)index.size(), &pairs) != 0)
        return std::puts("no lists"), 1;
    device = host;
    device.h = to_device(&h, 1);
    device.start = to_device(start.data(), start.size());
    device.index = to_device(index.data(), (size_t)pairs);
    device.a[0] = to_device(data.data(), data.size());
    for (int k = 1; k < FIELDS; k++) device.a[k] = device.a[0] + (size_t)k * (size_t)n;

    std::printf("%s, %s, %d particles, %.1f neighbours\n%-20s %12s %12s %10s %16s\n", properties.name, sizeof(sph_real) == 4 ? "float" : "double", (int)n,
                (double)pairs / n, "ns per particle", "GPU", "one core", "ratio", "largest error");
    return compare<DENSITY>(host, device) + compare<GRADIENT>(host, device) + compare<MSPH>(host, device) + compare<MHD>(host, device) != 0;
}
