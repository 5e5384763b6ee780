#!/bin/sh
# SPDX-License-Identifier: MIT
# The known answers are what their derivation says, where Python 3 is installed to run it; the densities of a
# lattice in examples/OPERATORS.md are what hello_kernel prints.
. tests/check.sh
if needs "derivation of the known answers" python3; then
    check "derivation of tests/known/kernels.csv" python3 tests/known/derive_kernels.py --check tests/known/kernels.csv
fi
check "hello_kernel compiles" $CC -std=c99 -O1 -I. -o "$scratch/hello_kernel" examples/hello_kernel.c -lm
"$scratch/hello_kernel" -l > "$scratch/printed"
sed -n '/^kernel  *h\/dx/,/^```/p' examples/OPERATORS.md | sed '$d' > "$scratch/said"
check "lattice densities in examples/OPERATORS.md" diff "$scratch/said" "$scratch/printed"
check "lattice densities of every kernel" test "$(wc -l < "$scratch/printed")" -ge 25
finish "known answers"
