// SPDX-License-Identifier: MIT
//
// host_cuda.cu - density and the M-SPH Laplacian on a GPU, one thread a particle, from neighbour lists in CSR
// form, against the host; and the kernels against the known answers.
//
//     nvcc -std=c++17 -O2 -I. examples/hosts/host_cuda.cu -o host_cuda && ./host_cuda
//                                                 (from the repository's root; -DSPH_SINGLE=1: in float)
//
// Exit status 0 if all is right, 77 if there is no GPU here.

#define SPH_CHECK 0 // a thread must not scan all particles; scan them on the host, in a file with SPH_CHECK 1
#include "gpu_case.h"

#include <cstdio>
#include <cstdlib>

// A thread is the range [i, i + 1) of targets; the cloud goes to the device by value, with addresses there.
__global__ void density(sph_cloud cloud, sph_scalars m, sph_scalar_out rho)
{
    const sph_index i = sph_index(blockIdx.x * blockDim.x + threadIdx.x);
    if (i < cloud.points.n)
        sph_density_summation(CASE_KERNEL, CASE_DIM, sph_cloud_range(cloud, i, i + 1), m, rho);
}
__global__ void msph(sph_cloud cloud, sph_scalars mobility, sph_scalars u, sph_scalar_out laplacian)
{
    const sph_index i = sph_index(blockIdx.x * blockDim.x + threadIdx.x);
    const sph_elliptic_options options = {};
    if (i < cloud.points.n)
        sph_elliptic_msph(CASE_KERNEL, CASE_DIM, sph_cloud_range(cloud, i, i + 1), mobility, options, u,
                          laplacian);
}
// W and F of kernels that are chosen at run time
__global__ void known(int rows, const known_row *row, sph_real *w, sph_real *f)
{
    const int i = int(blockIdx.x * blockDim.x + threadIdx.x);
    if (i >= rows) return;
    const sph_wf v = sph_kernel_wf(sph_kernel(row[i].kernel), row[i].dim, SPH_R(row[i].r), SPH_R(row[i].h));
    w[i] = v.w;
    f[i] = v.f;
}

static void stop_on(cudaError_t error, const char *what)
{
    if (error == cudaSuccess) return;
    std::printf("%s: %s\n", what, cudaGetErrorString(error));
    std::exit(1);
}

static gpu_case c;

int main()
{
    const int threads = 128, blocks = (CASE_N + threads - 1) / threads;
    cudaDeviceProp properties;
    gpu_case *d; // the same case in the device's memory: its members are the addresses that the views need
    int devices = 0;

    if (case_make(&c, "tests/known/kernels.csv") != 0)
        return std::puts("no cloud, or no tests/known/kernels.csv"), 1;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0)
        return std::puts("no GPU here: compiled, not run"), 77;
    stop_on(cudaGetDeviceProperties(&properties, 0), "cudaGetDeviceProperties");
    stop_on(cudaMalloc(&d, sizeof c), "cudaMalloc");
    stop_on(cudaMemcpy(d, &c, sizeof c, cudaMemcpyHostToDevice), "cudaMemcpy");

    const sph_points x = sph_points_separate(CASE_N, d->x, d->y, d->z);
    const sph_list list = {d->start, d->index};
    const sph_cloud cloud = sph_cloud_of(x, list, sph_scalars_same(&d->h), sph_scalars_array(d->V));
    const sph_scalars mobility = sph_scalars_array(d->mobility), u = sph_scalars_array(d->u);
    density<<<blocks, threads>>>(cloud, sph_scalars_array(d->m),
                                 sph_scalar_out_array(d->rho_device, nullptr));
    msph<<<blocks, threads>>>(cloud, mobility, u, sph_scalar_out_array(d->laplacian_device, nullptr));
    known<<<(c.rows + threads - 1) / threads, threads>>>(c.rows, d->known, d->w, d->f);
    stop_on(cudaGetLastError(), "launch");
    stop_on(cudaMemcpy(&c, d, sizeof c, cudaMemcpyDeviceToHost), "cudaMemcpy");
    cudaFree(d);
    return case_compare(&c, properties.name) != 0;
}
