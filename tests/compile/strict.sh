#!/bin/sh
# SPDX-License-Identifier: MIT
# Every header alone and all together, in C99 and C++11, double and float, with warnings as errors; every test and example under the same warnings; the operators as
# OpenCL C 1.2. Compilers that are not installed are skipped aloud.
. tests/check.sh
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror -I. -fsyntax-only"
has() {
    command -v "$1" > /dev/null 2>&1 && return
    skip "strict warnings of $1" "not installed"
    return 1
}

for h in sph_kernels.h sph_ops.h sph.h; do printf '#include "%s"\nint main(void) { return 0; }\n' "$h" > "$scratch/only_$h.c"; done
printf '#include "sph.h"\n#include "sph_kernels.h"\n#include "sph_ops.h"\n#include "sph.h"\nint main(void) { return 0; }\n' > "$scratch/only_all.c"
both_precisions="$scratch/only_*.c $(ls tests/test_*.c | grep -v -e test_gsl -e test_common)"

for cc in gcc clang; do
    has $cc || continue
    for f in $both_precisions; do
        check "C99, double" $cc -std=c99 $warn "$f"
        check "C99, float" $cc -std=c99 $warn -DSPH_SINGLE=1 "$f"
    done
    for f in tests/test_common.c examples/*.c examples/papers/*.c examples/common/*.c; do check "C99" $cc -std=c99 $warn "$f"; done
done
for cxx in g++ clang++; do
    has $cxx || continue
    for f in "$scratch"/only_*.c; do
        check "C++11, double" $cxx -x c++ -std=c++11 $warn "$f"
        check "C++11, float" $cxx -x c++ -std=c++11 $warn -DSPH_SINGLE=1 "$f"
    done
done
if has clang; then
    for single in 0 1; do
        check "OpenCL C 1.2" clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -Werror -DSPH_SINGLE=$single -I. -include sph_ops.h -fsyntax-only /dev/null
    done
fi
finish strict
