#!/bin/sh
# SPDX-License-Identifier: MIT
# The complete program of README.md compiles without a warning and prints what its comment says; every function and file that the READMEs name exists.
. tests/check.sh
awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' README.md > "$scratch/program.c"
check "the program compiles" $CC -std=c99 -Wall -Wextra -Wpedantic -Werror -O2 -I. -o "$scratch/program" "$scratch/program.c" -lm
"$scratch/program" > "$scratch/output"
check "the program's output" grep -q "^f'' = 2.0000000000 at the end of the line, 2.0000000000 in the middle$" "$scratch/output"
for name in $(grep -o 'sph_[a-z0-9_]*' README.md | grep -v -x -e sph_kernels -e sph_ops | sort -u); do
    check "README.md names $name" grep -q -w "$name" sph_kernels.h sph_ops.h sph.h
done
for file in $(grep -h -o '`[a-z_/]*\.[a-z]*`' README.md examples/papers/README.md | tr -d '`' | grep / | sort -u); do
    check "a README names $file" test -e "$file"
done
finish readme
