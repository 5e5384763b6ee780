#!/bin/sh
# SPDX-License-Identifier: MIT
# The solvers once more with PETSc's beside them, where PETSc is installed.
. tests/check.sh
if ! installed pkg-config || ! pkg-config --exists PETSc; then
    skip "solvers against PETSc" "PETSc is not installed, or pkg-config does not find it (Debian: petsc-dev pkg-config)"
    exit 0
fi
flags=$(pkg-config --cflags --libs PETSc)
pkg-config --exists mpi && flags="$flags $(pkg-config --cflags --libs mpi)"
# shellcheck disable=SC2086
check "tests/test_sparse.c compiles with PETSc" $CC -std=c99 -O2 -DHAVE_PETSC=1 tests/test_sparse.c -o "$scratch/petsc" $flags -lm
[ $failed -eq 0 ] && exec "$scratch/petsc"
finish petsc
