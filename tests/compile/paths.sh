#!/bin/sh
# SPDX-License-Identifier: MIT
# The neighbour search in its other builds - AVX2, AVX-512, OpenMP, 64-bit indices - against the portable one: any path gives the same pairs but those within 8 ulp of the radius, any
# number of threads gives the same lists, bit for bit. Those that are compiled for this machine (GNU mode: sums are contracted to fused operations, and paths do not round alike) are
# compared with all pairs, too, as make test does for the build that the compiler makes by default.
. tests/check.sh
export OMP_WAIT_POLICY=passive # seven threads on two processors must not spin
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror"

# programs that run where these builds do
add='#include <immintrin.h>
int main(void) {
    volatile int one = 1;
    __m256i two = _mm256_add_epi32(_mm256_set1_epi32(one), _mm256_set1_epi32(one));
    return _mm256_extract_epi32(two, 0) != 2;
}'
threads_of='#include <omp.h>
int main(void) {
    int n = 0;
    #pragma omp parallel num_threads(2) reduction(+ : n)
    n += omp_get_num_threads();
    return n < 1;
}'

# sums NAME FLAGS...: builds and prints checksums; with no other test in it, where all that is asked of the build is these
sums() {
    name=$1
    shift
    # shellcheck disable=SC2086
    check "$name compiles" $cc -std=c99 -O1 $warn -I. "$@" tests/test_neighbors.c -o "$scratch/$name" -lm
    check "$name runs" sh -c "'$scratch/$name' checksums > '$scratch/$name.sums'"
}
# shellcheck disable=SC2317
same_pairs() { [ -s "$scratch/$1.sums" ] && [ "$(cut -d ' ' -f 1-7 "$scratch/$1.sums")" = "$(cut -d ' ' -f 1-7 "$scratch/$2.sums")" ]; }

for cc in gcc clang; do
    usable "paths of $cc" "$empty" '' "$cc -std=c99 -O1 $warn" -lm || continue
    macros=$($cc -march=native -dM -E -x c /dev/null 2> /dev/null)
    has() { printf '%s\n' "$macros" | grep -q "^#define $1 "; }
    native="-std=gnu99 -march=native"
    usable "paths of $cc" "$empty" '' "$cc -O1 $warn $native" -lm || continue
    avx2='' openmp=''
    if ! has __AVX2__; then
        skip "AVX2 path of $cc" "not on this machine"
    elif usable "AVX2 path of $cc" "$add" '' "$cc -std=c99 -O1 $warn -mavx2" -lm; then avx2=1; fi
    has __AVX512F__ && has __AVX512VL__ || skip "AVX-512 path of $cc" "not on this machine"
    usable "OpenMP of $cc" "$threads_of" '' "$cc -O1 $warn $native -fopenmp" -lm && openmp=1
    precisions="0 1"
    [ $cc = gcc ] || precisions=1 # of clang one, in which vectors are longest
    for single in $precisions; do
        portable=$cc-portable-$single best=$cc-best-$single flags="-DSPH_SINGLE=$single $native"
        sums "$portable" -DCHECKSUMS_ONLY=1 -DSPH_SINGLE=$single -DSPH_AVX512=0 -DSPH_AVX2=0
        if [ $avx2 ]; then
            sums $cc-avx2-$single -DCHECKSUMS_ONLY=1 -DSPH_SINGLE=$single -mavx2
            check "$cc, AVX2, SPH_SINGLE=$single: the pairs of the portable path" same_pairs $cc-avx2-$single "$portable"
        fi
        # shellcheck disable=SC2086
        sums "$best" $flags
        check "$cc, for this machine, SPH_SINGLE=$single: the pairs of the portable path" same_pairs "$best" "$portable"
        # what follows takes long, and knows little of precision: one for each compiler
        case $cc-$single in gcc-0) only=0 ;; clang-1) only=1 ;; *) continue ;; esac
        # of gcc with three threads, below
        [ $openmp ] && [ $cc = gcc ] || check "$cc, for this machine, SPH_SINGLE=$single: all pairs" "$scratch/$best"
        [ $openmp ] || continue
        # shellcheck disable=SC2086
        check "OpenMP compiles" $cc -std=c99 -O1 $warn -I. $flags -DCHECKSUMS_ONLY=$only -fopenmp -DSPH_OPENMP=1 tests/test_neighbors.c -o "$scratch/openmp" -lm
        for threads in 1 3; do
            check "$cc, $threads threads" sh -c "OMP_NUM_THREADS=$threads '$scratch/openmp' checksums > '$scratch/threads.sums'"
            check "$cc, $threads threads: the lists of none" cmp "$scratch/threads.sums" "$scratch/$best.sums"
        done
        # one with threads is known to be that of none: the rest once
        [ $cc = gcc ] || continue
        check "$cc, 3 threads: all pairs" env OMP_NUM_THREADS=3 "$scratch/openmp"
        for t in capacity index_range; do # these set the number of threads themselves
            # shellcheck disable=SC2086
            check "$t with OpenMP compiles" $cc -std=c99 -O1 -w -I. $flags -fopenmp -DSPH_OPENMP=1 tests/test_$t.c -o "$scratch/openmp-$t" -lm
            check "$cc, $t with 1, 2, 3, 7 threads, SPH_SINGLE=$single" "$scratch/openmp-$t"
        done
    done
    for single in $precisions; do
        sums $cc-64-$single -DCHECKSUMS_ONLY=1 -DSPH_SINGLE=$single -DSPH_INDEX=int64_t -march=native
        check "$cc, 64-bit indices, SPH_SINGLE=$single: the pairs of the portable path" same_pairs $cc-64-$single $cc-portable-$single
    done
done
if [ -s "$scratch/gcc-portable-1.sums" ] && [ -s "$scratch/clang-portable-1.sums" ]; then
    check "the pairs of gcc and clang" same_pairs clang-portable-1 gcc-portable-1
fi
finish paths
