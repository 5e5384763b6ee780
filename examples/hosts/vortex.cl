/* SPDX-License-Identifier: MIT
 *
 * vortex.cl - lists.h and vortex.h as an OpenCL program; host_opencl_vortex.c calls it.
 */
#if !SPH_SINGLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define SPH_CHECK 0
#include "sph.h"

#include "examples/hosts/vortex.h"
