/* SPDX-License-Identifier: MIT
 *
 * host_search.c - the search of host.h as a file of its own, for programs compiled with -DHOST_LINKED=1.
 */
#undef HOST_LINKED
#define HOST_LINKED 1
#define HOST_SEARCH_HERE
#include "host.h"
