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
[ $failed -eq 0 ] && check "alone" "$scratch/petsc"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 OMP_NUM_THREADS=1
if ! installed mpirun; then
    skip "solvers against PETSc on two ranks" "mpirun is not installed"
elif [ $failed -eq 0 ]; then
    check "two ranks" answers 0 "^test_sparse: [1-9][0-9]* passed, 0 failed" mpirun -n 2 "$scratch/petsc"
fi
finish petsc
