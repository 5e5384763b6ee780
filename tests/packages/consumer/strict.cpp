// SPDX-License-Identifier: MIT
#include <sph.h>

double density(double r, double h) { return sph_kernel_w(SPH_WENDLAND_C2, 3, r, h); }
