#!/bin/sh
# SPDX-License-Identifier: MIT
# Kernels against GSL's adaptive quadrature and derivatives, where GSL is installed.
BUILD=${BUILD:-build}
CC=${CC:-cc}
mkdir -p "$BUILD/tests"
echo '#include <gsl/gsl_version.h>
int main(void) { return 0; }' > "$BUILD/tests/has_gsl.c"
if ! $CC -o "$BUILD/tests/has_gsl" "$BUILD/tests/has_gsl.c" -lgsl -lgslcblas -lm 2> /dev/null; then
    echo "gsl: skipped, GSL is not installed (Debian: libgsl-dev)"
    exit 0
fi
$CC -std=c99 -O2 -I. -o "$BUILD/tests/gsl" tests/test_gsl.c -lgsl -lgslcblas -lm && exec "$BUILD/tests/gsl"
