/* SPDX-License-Identifier: MIT */
/*
 * fuzz.h - what the fuzz targets share: numbers out of bytes, memory of just the size that was asked for, and a condition that must hold whatever the bytes are.
 *
 * A target is a file with one LLVMFuzzerTestOneInput. Any of these makes a program of it (fuzz.sh does):
 *     clang -fsanitize=fuzzer,address,undefined target.c                       libFuzzer: runs until it is stopped, keeps what crashes
 *     afl-clang-fast -fsanitize=fuzzer target.c                                AFL++
 *     cc -fsanitize=address,undefined target.c replay.c                        replays the files that are named to it
 * The same bytes give the same run in all of them. From its end on an input reads as random bytes that follow from those before, so that a short one is a whole cloud, too.
 */
#ifndef FUZZ_H
#define FUZZ_H

/* Not forced inline: kernels and dimensions are run-time values here, and one copy of each function is enough. */
#if defined(__GNUC__) || defined(__clang__)
#  ifndef SPH_FN
#    define SPH_FN static __attribute__((noinline, unused))
#  endif
#endif
#if defined(__clang__)
#  pragma clang diagnostic ignored "-Wpass-failed" /* loops over a run-time kernel do not vectorise */
#endif

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct fuzz_input {
    const uint8_t *data;
    size_t left;
    uint64_t random; /* 0 at first */
} fuzz_input;

#define FUZZ_REQUIRE(condition) fuzz_require((condition) ? 1 : 0, __FILE__, __LINE__, #condition)
static inline void fuzz_require(int holds, const char *file, int line, const char *text)
{
    if (holds) return;
    fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, text);
    abort();
}

static inline unsigned fuzz_byte(fuzz_input *in)
{
    if (in->left == 0) { /* Knuth's linear congruential generator, the high bits */
        in->random = in->random * 6364136223846793005u + 1442695040888963407u;
        return (unsigned)(in->random >> 56);
    }
    in->left--;
    in->random = (in->random ^ *in->data) * 1099511628211u;
    return *in->data++;
}
/* 0 ... below - 1 */
static inline int fuzz_below(fuzz_input *in, int below) { return (int)(fuzz_byte(in) % (unsigned)below); }
static inline uint64_t fuzz_bits(fuzz_input *in, int bytes)
{
    uint64_t bits = 0;
    while (bytes-- > 0) bits = bits << 8 | fuzz_byte(in);
    return bits;
}
/* in [0, 1], both included, from two bytes */
static inline double fuzz_unit(fuzz_input *in) { return (double)fuzz_bits(in, 2) / 65535.0; }
/* any double, NaN and infinities too */
static inline double fuzz_any(fuzz_input *in)
{
    const uint64_t bits = fuzz_bits(in, 8);
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
/* Mostly from a coarse lattice in [-2, 2], so that particles coincide and distances are those of others; also fine numbers, the awkward ones, and any bits. */
static inline double fuzz_number(fuzz_input *in)
{
    static const double awkward[] = {0.0, -0.0, 1e-30, -1e-30, 1e-150, 1e-200, 1e30, -1e30, 1e150, 1e200, 4.9e-324, 2.2e-308, 1.7e308, -1.7e308, 1.2e-38, 3.4e38};
    const unsigned how = fuzz_byte(in);
    if (how < 128) return ((double)how - 64.0) / 32.0;
    if (how < 232) return 4.0 * fuzz_unit(in) - 2.0;
    if (how < 248) return awkward[how - 232];
    if (how < 250) return (double)NAN;
    if (how < 252) return how == 250 ? (double)INFINITY : -(double)INFINITY;
    return fuzz_any(in);
}
/* The same without what no cloud of particles has: finite, and within [-2, 2]. */
static inline double fuzz_tame(fuzz_input *in)
{
    const unsigned how = fuzz_byte(in);
    return how < 128 ? ((double)how - 64.0) / 32.0 : 4.0 * fuzz_unit(in) - 2.0;
}
/* positive, over many orders of magnitude around 1 */
static inline double fuzz_scale(fuzz_input *in, double decades) { return pow(10.0, decades * (2.0 * fuzz_unit(in) - 1.0)); }

/* Memory of just this size: the sanitizer sees one byte beyond. Never null. */
static inline void *fuzz_memory(size_t count, size_t size)
{
    void *const p = malloc(count * size > 0 ? count * size : 1);
    if (!p) exit(1);
    return p;
}

#endif
