#!/bin/sh
# SPDX-License-Identifier: MIT
# Kernels against GSL's adaptive quadrature and derivatives, where GSL is installed.
. tests/check.sh
printf '#include <gsl/gsl_version.h>\nint main(void) { return 0; }\n' > "$scratch/has.c"
if ! $CC -o "$scratch/has" "$scratch/has.c" -lgsl -lgslcblas -lm 2> /dev/null; then
    skip "kernels against GSL" "GSL is not installed (Debian: libgsl-dev)"
    exit 0
fi
check "tests/test_gsl.c compiles" $CC -std=c99 -O2 -I. -o "$scratch/gsl" tests/test_gsl.c -lgsl -lgslcblas -lm
[ $failed -eq 0 ] && exec "$scratch/gsl"
finish gsl
