#!/bin/sh
# SPDX-License-Identifier: MIT
# Kernels against GSL's adaptive quadrature and derivatives, where GSL is installed.
. tests/check.sh
if ! compiles "#include <gsl/gsl_version.h>\n$empty" "$CC" -lgsl -lgslcblas -lm; then
    skip "kernels against GSL" "GSL is not installed (Debian: libgsl-dev)"
    exit 0
fi
check "tests/test_gsl.c compiles" $CC -std=c99 -O2 -I. -o "$scratch/gsl" tests/test_gsl.c -lgsl -lgslcblas -lm
[ $failed -eq 0 ] && exec "$scratch/gsl"
finish gsl
