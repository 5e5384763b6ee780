#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints the three headers as one, sph_all.h: each without its inclusion of the one below; the licence once, at the end.
#     sh tests/packages/amalgamate.sh > sph_all.h          from the root of the repository
echo '/* SPDX-License-Identifier: MIT */'
echo '/* sph_all.h: sph_kernels.h, sph_ops.h and sph.h in one file, as they are. */'
echo
for h in sph_kernels.h sph_ops.h sph.h; do
    awk -v last=$([ $h = sph.h ] && echo 1 || echo 0) '/^#include "sph_/ { next } held { if (/^ \* MIT License/ && !last) exit; print "/*"; held = 0 } /^\/\*$/ { held = 1; next } { print }' $h
done
