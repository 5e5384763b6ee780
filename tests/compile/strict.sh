#!/bin/sh
# SPDX-License-Identifier: MIT
# Every header alone and all together, in C99 and C++11, double and float, with warnings as errors; every test and example under the same warnings; the operators as
# OpenCL C 1.2. Compilers that are not installed are skipped aloud.
BUILD=${BUILD:-build}
dir=$BUILD/strict
mkdir -p "$dir"
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror"
passed=0 failed=0

try() { # what, command ...
    what=$1
    shift
    if "$@" > "$dir/log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "strict: failed: $what: $*"
        head -n 5 "$dir/log"
    fi
}
has() {
    command -v "$1" > /dev/null 2>&1 && return 0
    echo "strict: $1 skipped, it is not installed"
    return 1
}

for h in sph_kernels.h sph_ops.h sph.h; do printf '#include "%s"\nint main(void) { return 0; }\n' "$h" > "$dir/only_$h.c"; done
printf '#include "sph.h"\n#include "sph_kernels.h"\n#include "sph_ops.h"\n#include "sph.h"\nint main(void) { return 0; }\n' > "$dir/only_all.c"

for cc in gcc clang; do
    has $cc || continue
    for single in 0 1; do
        for f in "$dir"/only_*.c; do
            try "$cc C99 float=$single $(basename "$f")" $cc -std=c99 $warn -DSPH_SINGLE=$single -I. -fsyntax-only "$f"
        done
        for f in tests/test_*.c; do
            [ "$f" = tests/test_gsl.c ] && continue
            [ $single = 1 ] && [ "$f" = tests/test_common.c ] && continue
            try "$cc C99 float=$single $f" $cc -std=c99 $warn -DSPH_SINGLE=$single -I. -fsyntax-only "$f"
        done
    done
    for f in examples/papers/*.c examples/common/*.c; do try "$cc $f" $cc -std=c99 $warn -fsyntax-only "$f"; done
done
for cxx in g++ clang++; do
    has $cxx || continue
    for single in 0 1; do
        for f in "$dir"/only_*.c; do
            try "$cxx C++11 float=$single $(basename "$f")" $cxx -x c++ -std=c++11 $warn -DSPH_SINGLE=$single -I. -fsyntax-only "$f"
        done
    done
done
if has clang; then
    for single in 0 1; do
        try "OpenCL C 1.2 float=$single" clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -Werror -DSPH_SINGLE=$single -I. -include sph_ops.h -fsyntax-only /dev/null
    done
fi
echo "strict: $passed passed, $failed failed"
[ $failed -eq 0 ]
