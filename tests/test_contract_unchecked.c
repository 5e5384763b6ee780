/* SPDX-License-Identifier: MIT */
/* test_contract_unchecked.c - the contract without the scans: arguments, degenerate clouds and memory answer as they do with them. */
#define SPH_CHECK 0
#include "test_contract.c"
