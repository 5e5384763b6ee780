#!/bin/sh
# SPDX-License-Identifier: MIT
# The neighbour search in its other builds - AVX2, AVX-512, OpenMP - against the portable one: any path gives the same pairs but those within 8 ulp of the radius, any number of
# threads gives the same lists, bit for bit. (tests/test_neighbors.c, built as the compiler does by default, proves the lists themselves.)
. tests/check.sh
cc=gcc
command -v gcc > /dev/null 2>&1 || cc=$CC

# sums NAME FLAGS...: the checksums of a build
sums() {
    name=$1
    shift
    check "$name compiles" $cc -std=c99 -O1 -I. "$@" tests/test_neighbors.c -o "$scratch/$name" -lm
    check "$name runs" sh -c "'$scratch/$name' checksums > '$scratch/$name.sums'"
}
same_pairs() { [ -s "$scratch/$1.sums" ] && [ "$(cut -d ' ' -f 1-7 "$scratch/$1.sums")" = "$(cut -d ' ' -f 1-7 "$scratch/portable.sums")" ]; }

macros=$($cc -march=native -dM -E -x c /dev/null 2> /dev/null)
has() { printf '%s\n' "$macros" | grep -q "^#define $1 "; }
sums portable -DSPH_AVX512=0 -DSPH_AVX2=0
if has __AVX2__ && has __BMI2__; then
    sums avx2 -mavx2 -mbmi2
    check "AVX2: the pairs of the portable path" same_pairs avx2
else skip "AVX2 path" "not on this machine"; fi
if has __AVX512F__ && has __AVX512VL__; then
    sums avx512 -march=native
    check "AVX-512: the pairs of the portable path" same_pairs avx512
else skip "AVX-512 path" "not on this machine"; fi
printf '#include <omp.h>\nint main(void) { return omp_get_max_threads() < 1; }\n' > "$scratch/has.c"
if $cc -fopenmp "$scratch/has.c" -o "$scratch/has" > /dev/null 2>&1; then
    check "OpenMP compiles" $cc -std=c99 -O1 -I. -fopenmp -DSPH_OPENMP=1 -DSPH_SIMD=0 -DSPH_AVX512=0 -DSPH_AVX2=0 tests/test_neighbors.c -o "$scratch/openmp" -lm
    for threads in 1 2 3; do
        check "$threads threads" sh -c "OMP_NUM_THREADS=$threads '$scratch/openmp' checksums > '$scratch/threads.sums'"
        check "$threads threads: the lists of none" cmp "$scratch/threads.sums" "$scratch/portable.sums"
    done
else skip "OpenMP" "not installed"; fi
finish paths
