#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the public functions of the headers, one 'TYPE|NAME|PARAMETERS' a line. From the root of the repository.
cat sph_kernels.h sph_ops.h sph.h | tr '\n' ' ' | sed 's,/\*,\n&,g; s,\*/,&\n,g' | grep -v '^/\*' |
    tr '\n' ' ' | sed 's/SPH_FN /\n/g' |
    sed -n 's/^\([^(){};]*[ *]\)\(sph_[a-z0-9_]*\)(\([^(){};]*\)) *{.*/\1|\2|\3/p' | sed 's/  */ /g'
