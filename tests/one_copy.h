/* SPDX-License-Identifier: MIT */
/* one_copy.h - include it before the headers in a test that calls the operators with run-time kernels and dimensions: one copy of each function, not forced inline, compiles in seconds instead of minutes. */
#ifndef ONE_COPY_H
#define ONE_COPY_H

#if !defined(SPH_FN) && (defined(__GNUC__) || defined(__clang__))
#define SPH_FN static __attribute__((noinline, unused))
#endif
/* and what the sweeps pass to the pair functions is what those need */
#ifndef SPH_ASSERT
#include <assert.h>
#define SPH_ASSERT(x) assert(x)
#endif
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wpass-failed" /* loops over a run-time kernel do not vectorise */
#endif

#endif
