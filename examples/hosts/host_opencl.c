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
#define CL_TARGET_OPENCL_VERSION 120
#include "gpu_case.h"

#include <CL/cl.h>

static gpu_case c;

static void stop_on(cl_int error, const char *what)
{
    if (error == CL_SUCCESS) return;
    printf("%s: OpenCL error %d\n", what, (int)error);
    exit(1);
}

static cl_context context;
static cl_command_queue queue;
static cl_program program;
static cl_mem copy(size_t size, const void *from)
{
    cl_int error;
    const cl_mem m = clCreateBuffer(context, from ? CL_MEM_READ_ONLY : CL_MEM_READ_WRITE, size, 0, &error);
    stop_on(error, "clCreateBuffer");
    if (from)
        stop_on(clEnqueueWriteBuffer(queue, m, CL_TRUE, 0, size, from, 0, 0, 0), "clEnqueueWriteBuffer");
    return m;
}
static void back(cl_mem m, size_t size, void *to)
{
    stop_on(clEnqueueReadBuffer(queue, m, CL_TRUE, 0, size, to, 0, 0, 0), "clEnqueueReadBuffer");
}

/* runs a kernel over n work items: the count if there is one, then buffers */
static void run(const char *name, size_t n, const sph_index *count, int buffers, const cl_mem *buffer)
{
    cl_int error;
    cl_uint argument = 0;
    int i;
    const cl_kernel kernel = clCreateKernel(program, name, &error);
    stop_on(error, name);
    if (count) stop_on(clSetKernelArg(kernel, argument++, sizeof *count, count), name);
    for (i = 0; i < buffers; i++)
        stop_on(clSetKernelArg(kernel, argument++, sizeof(cl_mem), &buffer[i]), name);
    stop_on(clEnqueueNDRangeKernel(queue, kernel, 1, 0, &n, 0, 0, 0, 0), name);
    stop_on(clFinish(queue), name);
    clReleaseKernel(kernel);
}

int main(int argc, char **argv)
{
    static const char *const source = "#include \"examples/hosts/sweeps.cl\"\n";
    static char options[256], name[256], log[16384];
    static int k[KNOWN_MAX], dim[KNOWN_MAX];
    static sph_real r[KNOWN_MAX], h[KNOWN_MAX];
    const char *const version = argc > 1 ? argv[1] : "CL1.2";
    const sph_index n = CASE_N;
    cl_platform_id platform;
    cl_device_id device;
    cl_device_fp_config doubles = 0;
    cl_int error;
    int i;

    if (case_make(&c, "tests/known/kernels.csv") != 0)
        return puts("no cloud, or no tests/known/kernels.csv"), 1;
    if (clGetPlatformIDs(1, &platform, 0) != CL_SUCCESS ||
        clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, 0) != CL_SUCCESS)
        return puts("no OpenCL device"), 77;
    clGetDeviceInfo(device, CL_DEVICE_NAME, sizeof name, name, 0);
    clGetDeviceInfo(device, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, 0);
    if (!SPH_SINGLE && !doubles) return printf("%s has no doubles: compile with -DSPH_SINGLE=1\n", name), 77;
    context = clCreateContext(0, 1, &device, 0, 0, &error);
    stop_on(error, "clCreateContext");
    queue = clCreateCommandQueue(context, device, 0, &error);
    stop_on(error, "clCreateCommandQueue");

    program = clCreateProgramWithSource(context, 1, (const char **)&source, 0, &error);
    stop_on(error, "clCreateProgramWithSource");
    snprintf(options, sizeof options, "-I. -cl-std=%.8s -DSPH_SINGLE=%d", version, SPH_SINGLE);
    if (clBuildProgram(program, 1, &device, options, 0, 0) != CL_SUCCESS) {
        clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof log, log, 0);
        return puts(log), 1;
    }

    {
        const cl_mem x = copy(sizeof c.x, c.x), y = copy(sizeof c.y, c.y), z = copy(sizeof c.z, c.z),
                     start = copy(sizeof c.start, c.start), index = copy(sizeof c.index, c.index);
        const cl_mem H = copy(sizeof c.h, &c.h), m = copy(sizeof c.m, c.m), V = copy(sizeof c.V, c.V),
                     mobility = copy(sizeof c.mobility, c.mobility), u = copy(sizeof c.u, c.u);
        const cl_mem rho = copy(sizeof c.rho, 0), laplacian = copy(sizeof c.laplacian, 0);
        const cl_mem density[] = {x, y, z, start, index, H, m, rho},
                     msph[] = {x, y, z, start, index, H, V, mobility, u, laplacian};
        run("density", CASE_N, &n, 8, density);
        run("msph", CASE_N, &n, 10, msph);
        back(rho, sizeof c.rho, c.rho_device);
        back(laplacian, sizeof c.laplacian, c.laplacian_device);
    }
    for (i = 0; i < c.rows; i++) {
        k[i] = c.known[i].kernel;
        dim[i] = c.known[i].dim;
        r[i] = SPH_R(c.known[i].r);
        h[i] = SPH_R(c.known[i].h);
    }
    {
        const cl_mem w = copy(sizeof c.w, 0), f = copy(sizeof c.f, 0), known[] = {copy(sizeof k, k),
                                                                                  copy(sizeof dim, dim),
                                                                                  copy(sizeof r, r),
                                                                                  copy(sizeof h, h),
                                                                                  w,
                                                                                  f};
        run("known", (size_t)c.rows, 0, 6, known);
        back(w, sizeof c.w, c.w);
        back(f, sizeof c.f, c.f);
    }
    printf("OpenCL C %s on ", version + 2);
    return case_compare(&c, name) != 0;
}
