/* SPDX-License-Identifier: MIT */
/*
 * host_opencl.c - density and the M-SPH Laplacian in an NDRange over the particles, from neighbour lists in
 * CSR form (sweeps.cl), against the host; and the kernels against the known answers.
 *
 *     cc -O2 -I. examples/hosts/host_opencl.c -o host_opencl -lOpenCL -lm && ./host_opencl
 *                                                 (from the repository's root; -DSPH_SINGLE=1: in float)
 *
 * ./host_opencl CL1.2 asks for that version of the language, CL3.0 for that one. Exit status 0 if all is
 * right, 77 if there is no device (or none with doubles).
 */
#include "gpu_case.h"
#include "opencl.h"

static gpu_case c;

/* runs a kernel over n work items: the count if there is one, then buffers */
static void run(const char *name, size_t n, const sph_index *count, int buffers, const cl_mem *buffer)
{
    opencl_argument a[16];
    int i, arguments = 0;
    if (count) {
        a[arguments].size = sizeof *count;
        a[arguments++].p = count;
    }
    for (i = 0; i < buffers; i++) {
        a[arguments].size = sizeof(cl_mem);
        a[arguments++].p = &buffer[i];
    }
    opencl_run(name, n, 0, arguments, a);
}

int main(int argc, char **argv)
{
    static int k[KNOWN_MAX], dim[KNOWN_MAX];
    static sph_real r[KNOWN_MAX], h[KNOWN_MAX];
    const char *const version = argc > 1 ? argv[1] : "CL1.2";
    const sph_index n = CASE_N;
    int i;

    if (case_make(&c, "tests/known/kernels.csv") != 0)
        return puts("no cloud, or no tests/known/kernels.csv"), 1;
    opencl_begin("examples/hosts/sweeps.cl", version, SPH_SINGLE);
    {
        const cl_mem x = opencl_copy(sizeof c.x, c.x), y = opencl_copy(sizeof c.y, c.y),
                     z = opencl_copy(sizeof c.z, c.z), start = opencl_copy(sizeof c.start, c.start),
                     index = opencl_copy(sizeof c.index, c.index);
        const cl_mem H = opencl_copy(sizeof c.h, &c.h), m = opencl_copy(sizeof c.m, c.m),
                     V = opencl_copy(sizeof c.V, c.V), mobility = opencl_copy(sizeof c.mobility, c.mobility),
                     u = opencl_copy(sizeof c.u, c.u);
        const cl_mem rho = opencl_copy(sizeof c.rho, 0), laplacian = opencl_copy(sizeof c.laplacian, 0);
        const cl_mem density[] = {x, y, z, start, index, H, m, rho},
                     msph[] = {x, y, z, start, index, H, V, mobility, u, laplacian};
        run("density", CASE_N, &n, 8, density);
        run("msph", CASE_N, &n, 10, msph);
        opencl_back(rho, 0, sizeof c.rho, c.rho_device);
        opencl_back(laplacian, 0, sizeof c.laplacian, c.laplacian_device);
    }
    for (i = 0; i < c.rows; i++) {
        k[i] = c.known[i].kernel;
        dim[i] = c.known[i].dim;
        r[i] = SPH_R(c.known[i].r);
        h[i] = SPH_R(c.known[i].h);
    }
    {
        const cl_mem w = opencl_copy(sizeof c.w, 0), f = opencl_copy(sizeof c.f, 0),
                     known[] = {opencl_copy(sizeof k, k),
                                opencl_copy(sizeof dim, dim),
                                opencl_copy(sizeof r, r),
                                opencl_copy(sizeof h, h),
                                w,
                                f};
        run("known", (size_t)c.rows, 0, 6, known);
        opencl_back(w, 0, sizeof c.w, c.w);
        opencl_back(f, 0, sizeof c.f, c.f);
    }
    printf("OpenCL C %s on ", version + 2);
    return case_compare(&c, opencl.name) != 0;
}
