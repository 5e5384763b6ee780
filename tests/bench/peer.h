/* SPDX-License-Identifier: MIT */
/*
 * peer.h - what bench.c asks of another code that searches neighbours. An adapter, NAME.cpp, has one of these
 * under the name peer_NAME. What a code keeps from one time step to the next is made once and is not timed.
 */
#ifndef PEER_H
#define PEER_H

#include <stddef.h>

#if SPH_SINGLE
typedef float peer_real;
#else
typedef double peer_real;
#endif

typedef struct peer_cloud {
    size_t n;
    const peer_real *x, *y, *z;
    const peer_real *radius;
    int each; /* 1: one radius for each particle; 0: the same for all */
} peer_cloud;

typedef struct peer {
    const char *name;
    void *(*make)(const peer_cloud *cloud); /* null if the code cannot do this, or memory runs out */
    long long (*run)(void *made);           /* all neighbours j != i with r_ij < R_i: how many; -1 if it fails */
    void (*end)(void *made);
} peer;

#endif
