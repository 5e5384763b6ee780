#!/bin/sh
# SPDX-License-Identifier: MIT
# Kernels against GSL's adaptive quadrature and derivatives, where GSL is installed.
. tests/check.sh
uses_gsl="#include <gsl/gsl_version.h>\n$empty"
if ! compiles "$uses_gsl" "$CC" -lgsl -lgslcblas -lm; then
    skip "kernels against GSL" "$CC finds no GSL (a package of Debian: libgsl-dev)"
    exit 0
fi
usable "kernels against GSL" "$uses_gsl" '' "$CC" -lgsl -lgslcblas -lm || finish gsl
check "tests/test_gsl.c compiles" $CC -std=c99 -O2 -I. -o "$scratch/gsl" tests/test_gsl.c -lgsl -lgslcblas -lm
[ $failed -eq 0 ] && exec "$scratch/gsl"
finish gsl
