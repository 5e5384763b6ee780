#!/bin/sh
# SPDX-License-Identifier: MIT
# The corpus of every fuzz target replayed with the address and undefined-behaviour sanitizers (double, and float where the headers are what is tested), then FUZZ_SECONDS (60) of libFuzzer for each.
#     sh tests/fuzz/fuzz.sh [TARGET ...]
#     FUZZER=afl sh tests/fuzz/fuzz.sh [TARGET ...]        AFL++ instead
# What crashes is kept as $BUILD/fuzz/crash-TARGET-...; put it into tests/fuzz/corpus/TARGET once it is mended. TARGET-avx2 and -avx512 are the target with that inner loop of the search, where the processor
# has it; TARGET-crowded with crowded cells already at four particles, TARGET-openmp with threads as well.
. tests/check.sh
seconds=${FUZZ_SECONDS:-60}
work=$BUILD/fuzz
search="neighbors neighbors-avx2 neighbors-avx512 neighbors-crowded neighbors-openmp"
all="kernels $search derivatives sweeps sparse spe10 restart commands"
sanitize="-g -fsanitize=address,undefined -fno-sanitize-recover=all"
optimise=-O1 # takes three times as long to compile
[ "$seconds" -lt 30 ] && optimise=-O0
mkdir -p "$work/examples"
case ${FUZZER:-libfuzzer} in
libfuzzer) compiler=clang ;;
afl) compiler=afl-clang-fast ;;
*) echo "FUZZER is libfuzzer or afl" >&2 && exit 2 ;;
esac
TMPDIR=$PWD/$scratch # what a target leaves behind when it is stopped
case $BUILD in /*) TMPDIR=$scratch ;; esac
OMP_WAIT_POLICY=passive # threads are more than processors
export TMPDIR OMP_WAIT_POLICY
here=$($CC -march=native -dM -E -x c /dev/null 2> /dev/null)
# path TARGET: the flags of its path, or fails, aloud, where the processor does not have it
path() {
    case $1 in
    *-avx2) macros="__AVX2__" flags="-mavx2" ;;
    *-avx512) macros="__AVX512F__ __AVX512VL__" flags=-march=native ;;
    *-crowded) macros='' flags="-DSPHI_CROWDED=4 -DSPHI_LEAF=1" ;;
    *-openmp) macros='' flags="-fopenmp -DSPH_OPENMP=1 -DSPHI_CROWDED=4 -DSPHI_LEAF=2" ;;
    *) macros='' flags='' ;;
    esac
    for macro in $macros; do
        case $here in *"#define $macro 1"*) ;; *) skip "$1" "not on this processor" && return 1 ;; esac
    done
}
# fuzz TARGET COMMAND ...: one at a time, while the next one is compiled and replayed
fuzz() {
    target=$1
    shift
    wait
    (
        "$@" > "$work/log-$target" 2>&1
        echo $? > "$work/status-$target"
    ) &
    started="$started $target"
}

# the command lines of the drivers that were built, and of the other examples, built here for the sake of speed without optimisation
for f in examples/*.c; do
    case " ${*:-commands} " in *" commands "*) ;; *) continue ;; esac
    program=$work/examples/$(basename "$f" .c)
    check "$f" "$CC" -std=c99 -I. "$freely" -O0 "$f" -o "$program" -lm
done
FUZZ_PROGRAMS=$BUILD/examples:$work/examples
export FUZZ_PROGRAMS

started=
for t in ${*:-$all}; do
    path "$t" || continue
    source=tests/fuzz/${t%%-*}.c corpus=tests/fuzz/corpus/${t%%-*}
    # shellcheck disable=SC2086
    if usable "replay of $t" "$empty" '' "$CC" -fsanitize=address,undefined $flags; then
        for single in 0 1; do
            case $single$t in 1sparse | 1spe10 | 1restart | 1commands) continue ;; esac
            # shellcheck disable=SC2086
            check "$t, SPH_SINGLE=$single, compiles" $CC -std=c99 -I. -O0 "$freely" $sanitize $flags -DSPH_SINGLE=$single "$source" tests/fuzz/replay.c -o "$scratch/$t" -lm
            check "$t, SPH_SINGLE=$single, replays $corpus" "$scratch/$t" "$corpus"/*
        done
    fi
    mkdir -p "$work/corpus/$t" "$work/afl"
    rm -rf "$work"/crash-"$t"-* "$work/status-$t" "$work/afl/$t"
    # shellcheck disable=SC2086
    if usable "fuzzing of $t" "$empty" '' "$compiler" -fsanitize=fuzzer-no-link,address,undefined $flags; then
        # shellcheck disable=SC2086
        check "$t with $compiler compiles" "$compiler" -std=c99 -I. -fsanitize=fuzzer $optimise "$freely" $sanitize $flags "$source" -o "$work/$t" -lm
        if [ "$compiler" = clang ]; then
            fuzz "$t" "$work/$t" -max_total_time="$seconds" -timeout=20 -len_control=0 -max_len=600 -verbosity=0 -artifact_prefix="$work/crash-$t-" "$work/corpus/$t" "$corpus"
        else
            fuzz "$t" env AFL_NO_UI=1 AFL_SKIP_CPUFREQ=1 AFL_I_DONT_CARE_ABOUT_MISSING_CRASHES=1 afl-fuzz -V "$seconds" -t 20000 -m none -G 600 -i "$corpus" -o "$work/afl/$t" -- "$work/$t"
        fi
    fi
done
wait
for t in $started; do
    for f in "$work/afl/$t"/default/crashes/id* "$work/afl/$t"/default/hangs/id*; do [ -e "$f" ] && cp "$f" "$work/crash-$t-$(basename "$f" | tr -c 'A-Za-z0-9\n' _)"; done
    check "$t for $seconds s" grep -q -x 0 "$work/status-$t"
    check "$t: nothing crashes" sh -c "! ls '$work'/crash-'$t'-*"
    grep -a -e "ended with" -e "does not hold" -e "runtime error" -e "ERROR: " "$work/log-$t" | head -n 3
done
finish fuzz
