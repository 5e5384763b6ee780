#!/bin/sh
# SPDX-License-Identifier: MIT
# What static and dynamic analysers find, which must be nothing: gcc -fanalyzer, clang's analyser (scan-build's), clang-tidy, cppcheck, Eva (Frama-C); valgrind, the sanitizers of memory and of threads. Skips
# aloud what is not installed. Some twelve minutes.
#     make lint
. tests/check.sh
quiet() { # prints nothing, and succeeds
    "$@" > "$scratch/said" 2>&1
    status=$?
    grep -v -e '^[0-9]* warnings\? generated' -e '^Suppressed ' -e '^Use -header-filter' "$scratch/said"
    [ $status -eq 0 ] && ! grep -q -e 'warning:' -e 'error:' "$scratch/said"
}
# every function of the headers, with kernel and dimension unknown; preconditions are facts
echo '#include "sph.h"
int all_of_it;' > "$scratch/all.c"
every="-DSPH_FN=static __attribute__((noinline, used))"
fact="-DSPH_ASSERT(x)=if (!(x)) __builtin_unreachable()"

if needs "gcc -fanalyzer" gcc; then check "gcc -fanalyzer" quiet gcc -std=c99 -O1 -fanalyzer -Wall -Wextra "$every" "$fact" -I. -c -o /dev/null "$scratch/all.c"; fi
if needs "clang --analyze" clang; then
    check "clang --analyze" quiet clang --analyze -Xclang -analyzer-opt-analyze-headers -Xclang -analyzer-inline-max-stack-depth -Xclang 6 -Xclang -analyzer-output=text -std=c99 "$every" "$fact" -I. -o /dev/null "$scratch/all.c"
fi
# what a host sees that does not know the dimension, and defines no SPH_ASSERT: here nothing is a fact
cat > "$scratch/solvers.c" << 'END'
#include "sph_ops.h"
int a(int dim, const sph_moments *m, sph_jet *j, sph_real *c) { return sph_solve_block(dim, m, 1, j, c); }
int b(int dim, const sph_moments *m, sph_jet *j, sph_real *c) { return sph_solve_cspm(dim, m, 1, j, c); }
int d(int dim, int icspm, const sph_moments *m, sph_jet op, sph_coefficients *c, sph_real *k)
{
    return sph_coefficients_block(dim, icspm, m, 1, op, c, k);
}
int e(int dim, const sph_moments *m, sph_jet op, sph_coefficients *c)
{
    return sph_coefficients_cspm(dim, m, 1, op, c, 0);
}
END
if needs "clang --analyze of the solvers" clang; then
    check "clang --analyze of the solvers" quiet clang --analyze -Xclang -analyzer-output=text -std=c99 -I. -o /dev/null "$scratch/solvers.c"
fi
if needs clang-tidy clang-tidy; then
    # not easily-swappable-parameters (first, last, ...), macro-parentheses and branch-clone (lists of names and formulas by X-macros); integer-division and implicit-widening (columns and rows of
    # lattices, capacities that are constants); narrowing-conversions (-Wconversion says it better)
    tidy='-*,bugprone-*,performance-*,portability-*,-bugprone-easily-swappable-parameters,-bugprone-macro-parentheses,-bugprone-branch-clone,-bugprone-integer-division,-bugprone-implicit-widening-of-multiplication-result,-bugprone-narrowing-conversions'
    for f in "$scratch/all.c" examples/*.c; do check "clang-tidy $f" quiet clang-tidy --quiet --checks="$tidy" --header-filter='sph[a-z_]*[.]h' "$f" -- -std=c99 -I.; done
fi
if needs cppcheck cppcheck; then
    for f in sph.h examples/*.c; do
        # its idea of an array that a loop or a called function fills is too simple: the sanitizers look at that
        check "cppcheck $f" quiet cppcheck --enable=warning,performance,portability --std=c99 --language=c -q --error-exitcode=1 -DSPH_PURE_SQRT=0 --suppress=uninitvar --suppress=legacyUninitvar -I. "$f"
    done
fi

sound() { # SPH_SINGLE: Eva has no alarm, and has met every function but sphi_pos, of which eva.c says what it does
    frama-c -eva -cpp-extra-args="-I. -DSPH_FN=static -DSPH_PURE_SQRT=0 -DSPH_SINGLE=$1" -eva-use-spec sphi_pos -eva-min-loop-unroll 100 -eva-msg-key=-initial-state,-final-states \
        tests/lint/eva.c > "$scratch/eva" 2>&1 && grep -q '^ *0 alarms generated' "$scratch/eva" &&
        awk '/functions analyzed/ { sub(/\):/, ""); n++; if ($1 + 1 != $6) bad = 1 } END { exit bad || n != 1 }' "$scratch/eva" && return
    grep -A 4 -e 'eva:alarm' -e 'functions analyzed' -e 'rror:' "$scratch/eva"
    return 1
}
if needs "Eva (Debian: frama-c-base)" frama-c; then
    for single in 0 1; do check "Eva, SPH_SINGLE=$single" sound $single; done
fi

if needs valgrind valgrind && works valgrind valgrind -q sh -c :; then
    for t in known_answers derivatives collisions gravity; do
        check "$t" $CC -std=c99 -w -O1 -g "$one_copy" -I. -o "$scratch/$t" "tests/test_$t.c" -lm
        check "valgrind $t" valgrind -q --error-exitcode=9 --leak-check=full "$scratch/$t"
    done
fi
if usable "the memory sanitizer" "$empty" '' clang -fsanitize=memory; then
    for t in known_answers gradients derivatives density elliptic fluid collisions cleaning gravity invariance; do
        check "memory: $t" clang -std=c99 -w -O1 -g -fsanitize=memory -fno-sanitize-recover=all "$one_copy" -I. -o "$scratch/$t" "tests/test_$t.c" -lm
        check "memory: run $t" "$scratch/$t"
    done
fi
# Threads: those of the search, and a host's in ranges of every sweep, whose results must not depend on how many they are. gcc's OpenMP runtime is not built for the sanitizer, clang's tells it what it does
# (libarcher).
if usable "the thread sanitizer (Debian: libomp-dev)" "$empty" '' clang -fopenmp -fsanitize=thread; then
    for t in neighbors capacity invariance; do
        check "threads: $t" clang -std=c99 -w -O1 -g -fopenmp -DSPH_OPENMP=1 -fsanitize=thread -I. -o "$scratch/threads" tests/test_$t.c -lm
        check "threads: run $t" env OMP_NUM_THREADS=4 TSAN_OPTIONS=ignore_noninstrumented_modules=1 "$scratch/threads"
    done
fi
for cc in gcc clang; do
    if usable "threads by $cc" "$empty" '' $cc -fopenmp; then
        check "threads by $cc" $cc -std=c99 -w -O2 -fopenmp -I. -o "$scratch/threads" tests/test_invariance.c -lm
        for threads in 1 2 3 8; do check "$threads threads by $cc" env OMP_NUM_THREADS=$threads "$scratch/threads"; done
    fi
done
finish lint
