#!/bin/sh
# SPDX-License-Identifier: MIT
# The neighbour search in its other builds - AVX2, AVX-512, OpenMP, 64-bit indices - against all pairs (tests/test_neighbors.c, which make test builds as the compiler does by default)
# and against each other: any path gives the same pairs but those within 8 ulp of the radius, any number of threads gives the same lists, bit for bit. With -march=native clang, and
# gcc in GNU mode, contract sums to fused operations, so that paths do not round alike. Compilers and processors that are not there are skipped aloud.
. tests/check.sh
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror"

# build NAME FLAGS...
build() {
    name=$1
    shift
    rm -f "$scratch/$name"
    # shellcheck disable=SC2086
    check "$name compiles" $cc -std=c99 -O2 $warn -I. "$@" tests/test_neighbors.c -o "$scratch/$name" -lm
}
# sums NAME FLAGS...: the checksums of a build
sums() {
    build "$@"
    check "$name runs" sh -c "'$scratch/$name' checksums > '$scratch/$name.sums'"
}
same_pairs() { [ -s "$scratch/$1.sums" ] && [ "$(cut -d ' ' -f 1-7 "$scratch/$1.sums")" = "$(cut -d ' ' -f 1-7 "$scratch/$2.sums")" ]; }
# path NAME FLAGS...: all tests, and the pairs of the portable path of gcc (of this compiler, if there is no gcc)
path() {
    sums "$@"
    check "$name: all tests" "$scratch/$name" quick
    check "$name: the pairs of the portable path" same_pairs "$name" "$first-portable-$single"
}

first=
for cc in gcc clang; do
    if ! command -v $cc > /dev/null 2>&1; then
        skip "paths of $cc" "not installed"
        continue
    fi
    macros=$($cc -march=native -dM -E -x c /dev/null 2> /dev/null)
    has() { printf '%s\n' "$macros" | grep -q "^#define $1 "; }
    printf '#include <omp.h>\nint main(void) { return omp_get_max_threads() < 1; }\n' > "$scratch/has.c"
    openmp=0
    if $cc -fopenmp "$scratch/has.c" -o "$scratch/has" > /dev/null 2>&1 && "$scratch/has"; then openmp=1; else skip "OpenMP of $cc" "not installed"; fi

    for single in 0 1; do
        float="-DSPH_SINGLE=$single"
        sums $cc-portable-$single $float -DSPH_AVX512=0 -DSPH_AVX2=0
        [ -n "$first" ] || first=$cc
        check "$cc-portable-$single: the pairs of $first" same_pairs $cc-portable-$single $first-portable-$single
        best="-DSPH_AVX512=0 -DSPH_AVX2=0"
        if has __AVX2__ && has __BMI2__; then
            best="-march=native -std=gnu99"
            path $cc-avx2-$single $float -mavx2 -mbmi2
        else skip "AVX2 path of $cc" "not on this machine"; fi
        # shellcheck disable=SC2086
        if has __AVX512F__ && has __AVX512VL__; then path $cc-avx512-$single $float $best; else skip "AVX-512 path of $cc" "not on this machine"; fi

        [ $openmp = 1 ] || continue
        # shellcheck disable=SC2086
        sums $cc-single-$single $float $best # without threads
        # shellcheck disable=SC2086
        build $cc-openmp-$single $float $best -fopenmp -DSPH_OPENMP=1
        for threads in 1 2 3; do
            check "$name: $threads threads" sh -c "OMP_NUM_THREADS=$threads '$scratch/$name' checksums > '$scratch/threads.sums'"
            check "$name: $threads threads: the lists of none" cmp "$scratch/threads.sums" "$scratch/$cc-single-$single.sums"
        done
        check "$name: all tests with 3 threads" env OMP_NUM_THREADS=3 "$scratch/$name" quick
    done
    single=0
    # shellcheck disable=SC2086
    path $cc-64 -DSPH_INDEX=int64_t $best
done
finish paths
