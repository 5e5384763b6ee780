/* SPDX-License-Identifier: MIT */
/* opencl.h - what the OpenCL hosts share: one device with its queue, a program from a file, buffers, and
   kernels that are run and timed. An error ends the program with a message. */
#ifndef HOST_OPENCL_H
#define HOST_OPENCL_H
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>

static struct {
    cl_device_id device;
    cl_context context;
    cl_command_queue queue;
    cl_program program;
    char name[256];
} opencl;

static void opencl_stop_on(cl_int error, const char *what)
{
    if (error == CL_SUCCESS) return;
    printf("%s: OpenCL error %d\n", what, (int)error);
    exit(1);
}
/* The first device, and the file compiled for it in this version of the language. Ends with 77 if there is no
   device, or none with doubles where those are asked for. */
static void opencl_begin(const char *file, const char *version, int single)
{
    static char options[256], source[256], log[16384];
    const char *text = source;
    cl_platform_id platform;
    cl_device_fp_config doubles = 0;
    cl_int error;
    if (clGetPlatformIDs(1, &platform, 0) != CL_SUCCESS ||
        clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &opencl.device, 0) != CL_SUCCESS) {
        puts("no OpenCL device");
        exit(77);
    }
    clGetDeviceInfo(opencl.device, CL_DEVICE_NAME, sizeof opencl.name, opencl.name, 0);
    clGetDeviceInfo(opencl.device, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof doubles, &doubles, 0);
    if (!single && !doubles) {
        printf("%s has no doubles: compile with -DSPH_SINGLE=1\n", opencl.name);
        exit(77);
    }
    opencl.context = clCreateContext(0, 1, &opencl.device, 0, 0, &error);
    opencl_stop_on(error, "clCreateContext");
    opencl.queue = clCreateCommandQueue(opencl.context, opencl.device, CL_QUEUE_PROFILING_ENABLE, &error);
    opencl_stop_on(error, "clCreateCommandQueue");
    snprintf(source, sizeof source, "#include \"%s\"\n", file);
    opencl.program = clCreateProgramWithSource(opencl.context, 1, &text, 0, &error);
    opencl_stop_on(error, "clCreateProgramWithSource");
    snprintf(options, sizeof options, "-I. -cl-std=%.8s -DSPH_SINGLE=%d", version, single);
    if (clBuildProgram(opencl.program, 1, &opencl.device, options, 0, 0) == CL_SUCCESS) return;
    clGetProgramBuildInfo(opencl.program, opencl.device, CL_PROGRAM_BUILD_LOG, sizeof log, log, 0);
    puts(log);
    exit(1);
}
/* A buffer with a copy of what is there, or of zeros. */
static cl_mem opencl_copy(size_t size, const void *from)
{
    static const int zero = 0;
    cl_int error;
    const cl_mem m = clCreateBuffer(opencl.context, CL_MEM_READ_WRITE, size, 0, &error);
    opencl_stop_on(error, "clCreateBuffer");
    if (from) error = clEnqueueWriteBuffer(opencl.queue, m, CL_TRUE, 0, size, from, 0, 0, 0);
    else error = clEnqueueFillBuffer(opencl.queue, m, &zero, 1, 0, size, 0, 0, 0);
    opencl_stop_on(error, "clEnqueueWriteBuffer");
    return m;
}
static void opencl_back(cl_mem m, size_t from, size_t size, void *to)
{
    opencl_stop_on(clEnqueueReadBuffer(opencl.queue, m, CL_TRUE, from, size, to, 0, 0, 0),
                   "clEnqueueReadBuffer");
}
/* Bytes per ns that the device reads and writes where it copies its memory. */
static inline double opencl_bandwidth(void)
{
    const size_t size = (size_t)1 << 26;
    const cl_mem from = opencl_copy(size, 0), to = opencl_copy(size, 0);
    cl_ulong begin = 0, end = 0;
    double fastest = 0;
    int round;
    for (round = 0; round < 5; round++) {
        cl_event event;
        opencl_stop_on(clEnqueueCopyBuffer(opencl.queue, from, to, 0, 0, size, 0, 0, &event), "clEnqueueCopyBuffer");
        opencl_stop_on(clFinish(opencl.queue), "clFinish");
        clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof begin, &begin, 0);
        clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, 0);
        clReleaseEvent(event);
        if (end > begin && 2.0 * (double)size / (double)(end - begin) > fastest) fastest = 2.0 * (double)size / (double)(end - begin);
    }
    clReleaseMemObject(from), clReleaseMemObject(to);
    return fastest;
}
/* Runs a kernel over `items` work items, in groups of `group` (0: the device chooses), and returns its
   nanoseconds. */
typedef struct opencl_argument {
    size_t size;
    const void *p;
} opencl_argument;
#define ARGUMENT(v) \
    { \
        sizeof(v), &(v) \
    }
#define NUMBER(a) ((cl_int)(sizeof(a) / sizeof *(a)))
static double opencl_run(const char *name, size_t items, size_t group, int count, const opencl_argument *a)
{
    cl_int error;
    cl_event event;
    cl_ulong begin = 0, end = 0;
    int i;
    const cl_kernel kernel = clCreateKernel(opencl.program, name, &error);
    opencl_stop_on(error, name);
    for (i = 0; i < count; i++) opencl_stop_on(clSetKernelArg(kernel, (cl_uint)i, a[i].size, a[i].p), name);
    error = clEnqueueNDRangeKernel(opencl.queue, kernel, 1, 0, &items, group ? &group : 0, 0, 0, &event);
    opencl_stop_on(error, name);
    opencl_stop_on(clFinish(opencl.queue), name);
    clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof begin, &begin, 0);
    clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, 0);
    clReleaseEvent(event);
    clReleaseKernel(kernel);
    return (double)(end - begin);
}
#endif
