/* SPDX-License-Identifier: MIT */
/*
 * random.h - PCG32 random numbers: the same on every machine.
 *
 * PCG-XSH-RR 64/32 of M. E. O'Neill, "PCG: A Family of Simple Fast
 * Space-Efficient Statistically Good Algorithms for Random Number Generation",
 * Harvey Mudd College HMC-CS-2014-0905 (2014), https://www.pcg-random.org.
 */
#ifndef RANDOM_H
#define RANDOM_H

#include <stdint.h>

typedef struct pcg32 {
    uint64_t state;
    uint64_t increment; /* odd: selects the stream */
} pcg32;

/* The next 32 bits: a 64-bit linear congruential step, of whose old state the
 * high bits are folded (xorshift) and turned by its top five bits. */
static inline uint32_t pcg32_next(pcg32 *g)
{
    const uint64_t old = g->state;
    g->state = old * UINT64_C(6364136223846793005) + g->increment;
    const uint32_t folded = (uint32_t)(((old >> 18) ^ old) >> 27);
    const uint32_t turn = (uint32_t)(old >> 59);
    return (folded >> turn) | (folded << ((32U - turn) & 31U));
}

/* Equal seeds on different streams give independent sequences. */
static inline void pcg32_seed(pcg32 *g, uint64_t seed, uint64_t stream)
{
    g->state = 0;
    g->increment = (stream << 1) | 1U;
    pcg32_next(g);
    g->state += seed;
    pcg32_next(g);
}

/* Uniform in the open interval (0,1): a multiple of 2^-53 whose 53 bits are the
 * top 27 of one draw above the top 26 of the next.  0 is drawn again, so that
 * logarithms are safe; what is left is symmetric about 1/2. */
static inline double pcg32_uniform(pcg32 *g)
{
    uint64_t bits;
    do {
        const uint64_t high = pcg32_next(g) >> 5;
        bits = (high << 26) | (pcg32_next(g) >> 6);
    } while (bits == 0);
    return (double)bits * (1.0 / 9007199254740992.0);
}

#endif
