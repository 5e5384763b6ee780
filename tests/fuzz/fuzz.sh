#!/bin/sh
# SPDX-License-Identifier: MIT
# The corpus of every fuzz target replayed with the address and undefined-behaviour sanitizers (double, and float where the headers are what is tested), then FUZZ_SECONDS (60) of libFuzzer for each.
#     sh tests/fuzz/fuzz.sh [TARGET ...]
# What crashes is kept as $BUILD/fuzz/crash-TARGET-...; put it into tests/fuzz/corpus/TARGET once it is mended. With AFL++ instead: afl-clang-fast -fsanitize=fuzzer -I. tests/fuzz/TARGET.c -lm
. tests/check.sh
seconds=${FUZZ_SECONDS:-60}
work=$BUILD/fuzz
all="kernels neighbors derivatives sweeps sparse spe10 restart commands"
sanitize="-g -fsanitize=address,undefined -fno-sanitize-recover=all"
optimise=-O1 # takes three times as long to compile
[ "$seconds" -lt 30 ] && optimise=-O0
mkdir -p "$work/examples"
has_sanitizers() { echo 'int main(void) { return 0; }' > "$scratch/has.c" && $1 -fsanitize="$2" "$scratch/has.c" -o "$scratch/has" > /dev/null 2>&1; }

# the command lines of the drivers that were built, and of the other examples, built here for the sake of speed without optimisation
for f in examples/*.c; do
    case " ${*:-commands} " in *" commands "*) ;; *) continue ;; esac
    program=$work/examples/$(basename "$f" .c)
    check "$f" "$CC" -std=c99 -I. "-DSPH_FN=static __attribute__((noinline, unused))" -O0 "$f" -o "$program" -lm
done
FUZZ_PROGRAMS=$BUILD/examples:$work/examples
export FUZZ_PROGRAMS

started=
# kept TARGET: the files of a crash, with a name that says whose they are
kept() { ls "$work"/crash-"$1"-* 2> /dev/null | sed 's/^/kept: /'; }

for t in ${*:-$all}; do
    corpus=tests/fuzz/corpus/$t
    if has_sanitizers "$CC" address,undefined; then
        for single in 0 1; do
            case $single$t in 1sparse | 1spe10 | 1restart | 1commands) continue ;; esac
            # shellcheck disable=SC2086
            check "$t, SPH_SINGLE=$single, compiles" $CC -std=c99 -I. -O0 $sanitize -DSPH_SINGLE=$single "tests/fuzz/$t.c" tests/fuzz/replay.c -o "$scratch/$t" -lm
            check "$t, SPH_SINGLE=$single, replays $corpus" "$scratch/$t" "$corpus"/*
        done
    else skip "replay of $t" "$CC has no sanitizers"; fi
    if command -v clang > /dev/null 2>&1 && has_sanitizers clang fuzzer-no-link,address,undefined; then
        mkdir -p "$work/corpus/$t"
        rm -f "$work"/crash-"$t"-* "$work/status-$t"
        # shellcheck disable=SC2086
        check "$t with libFuzzer compiles" clang -std=c99 -I. -fsanitize=fuzzer $optimise $sanitize "tests/fuzz/$t.c" -o "$work/$t" -lm
        wait # one at a time, while the next one is compiled and replayed
        (
            "$work/$t" -max_total_time="$seconds" -timeout=20 -len_control=0 -max_len=600 -verbosity=0 -artifact_prefix="$work/crash-$t-" "$work/corpus/$t" "$corpus" > "$work/log-$t" 2>&1
            echo $? > "$work/status-$t"
        ) &
        started="$started $t"
    else skip "fuzzing of $t" "no clang with libFuzzer"; fi
done
wait
for t in $started; do
    check "$t for $seconds s" grep -q -x 0 "$work/status-$t"
    grep -a -e "does not hold" -e "runtime error" -e "ERROR: " "$work/log-$t" | head -n 3
    kept "$t"
done
finish fuzz
