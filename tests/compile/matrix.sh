#!/bin/sh
# SPDX-License-Identifier: MIT
# What compilers make of the headers, and of every test and example, with warnings as errors. Compilers that are not installed are skipped aloud.
#     tests/compile/matrix.sh [full]          from the repository root; JOBS=2: two at a time
# headers    alone and all together, double and float, in the oldest and (full: every) newer standard of C and C++; OpenCL C 1.2
# code       every function of the headers compiled, not only parsed, so that warnings that need the optimiser come up, too: -O2, and -O3 -march=native -ffast-math (full: -O0, and both
#            precisions of all)
# sources    every test and example under the same warnings
# runs       the self-check of tests/embedded, one program of a float part in C and a double part in C or C++: gcc, clang, tcc, musl, i686, mingw-w64 (run by wine, where installed)
. tests/check.sh
full=
[ "${1:-}" = full ] && full=1
rm -rf "$scratch/jobs" && mkdir -p "$scratch/jobs" || exit 2

# Not among the warnings: -Wfloat-equal and -Wbad-function-cast (comparisons with an exact 0 and casts of rounded values are meant).
basic="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror -I."
strict="$basic -Wsign-conversion -Wcast-qual -Wundef -Wvla -Wnull-dereference -Wredundant-decls"
strict_c="$strict -Wstrict-prototypes -Wmissing-prototypes -Wc++-compat -Wswitch-default"
strict_gcc="-Wlogical-op -Wduplicated-cond -Wduplicated-branches -Wcast-align=strict"
# what clang has besides; other versions know more or fewer
strict_clang="-Weverything -Wno-unknown-warning-option -Wno-padded -Wno-declaration-after-statement -Wno-comma -Wno-float-equal -Wno-bad-function-cast -Wno-covered-switch-default
    -Wno-switch-enum -Wno-unsafe-buffer-usage"

jobs=0
# job WHAT COMMAND...: the command, as text for a shell, is run later
job() {
    jobs=$((jobs + 1))
    printf '# %s\n' "$1" > "$scratch/jobs/$jobs"
    shift
    echo "$@" | tr '\n' ' ' >> "$scratch/jobs/$jobs"
}
has() {
    compiles "$empty" "$1" && return
    skip "$1" "not installed"
    return 1
}

for h in sph_kernels.h sph_ops.h sph.h; do printf '#include "%s"\nint main(void) { return 0; }\n' "$h" > "$scratch/only_$h.c"; done
printf '#include "sph.h"\n#include "sph_kernels.h"\n#include "sph_ops.h"\n#include "sph.h"\nint main(void) { return 0; }\n' > "$scratch/only_all.c"
awk -f tests/embedded/known.awk tests/known/kernels.csv > "$scratch/known_answers.h" || exit 2
printf '#ifdef __cplusplus\nextern "C" {\n#endif\nint check_float(void);\nint check_double(void);\n#ifdef __cplusplus\n}\n#endif\nint main(void) { return check_float() | check_double(); }\n' > "$scratch/both.c"
only="$scratch/only_sph_kernels.h.c $scratch/only_sph_ops.h.c $scratch/only_sph.h.c"

# ---------------------------------------------------------------- headers

for cc in gcc clang; do
    has $cc || continue
    for std in c99 c11 c17 c2x; do
        case $full$std in c11 | c17) continue ;; esac
        for single in 0 1; do job "headers, $cc, $std, SPH_SINGLE=$single" $cc -std=$std "$strict_c" -DSPH_SINGLE=$single -fsyntax-only "$only"; done
    done
    job "headers together, $cc" $cc -std=c99 "$strict_c" -fsyntax-only "$scratch/only_all.c"
    if [ $cc = clang ] && [ "$full" ]; then
        for single in 0 1; do
            job "headers, all warnings of clang, SPH_SINGLE=$single" clang -std=c99 "$strict_clang" -Werror -I. -DSPH_SINGLE=$single -fsyntax-only "$scratch/only_all.c"
            job "OpenCL C 3.0, SPH_SINGLE=$single" clang -x cl -cl-std=CL3.0 -Xclang -finclude-default-header -Werror -DSPH_SINGLE=$single -I. -include sph_ops.h -fsyntax-only /dev/null
        done
    fi
done
for cxx in g++ clang++; do
    has $cxx || continue
    for std in c++11 c++14 c++17 c++20; do
        case $full$std in c++14 | c++17) continue ;; esac
        for single in 0 1; do job "headers, $cxx, $std, SPH_SINGLE=$single" $cxx -x c++ -std=$std "$strict" -DSPH_SINGLE=$single -fsyntax-only "$only"; done
    done
    job "headers together, $cxx" $cxx -x c++ -std=c++11 "$strict" -fsyntax-only "$scratch/only_all.c"
done
if installed clang; then
    for single in 0 1; do
        job "OpenCL C 1.2, SPH_SINGLE=$single" clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -Werror -DSPH_SINGLE=$single -I. -include sph_ops.h -fsyntax-only /dev/null
    done
fi

# ---------------------------------------------------------------- code

# every function kept, once, called by none; clang's hint that a loop of calls was not vectorised says nothing then
all="'-DSPH_FN=static __attribute__((noinline, used))'"
for cc in gcc clang; do
    installed $cc || continue
    if [ $cc = gcc ]; then more=$strict_gcc; else more=-Wno-pass-failed; fi
    for single in 0 1; do
        if [ "$full" ] || [ $single = 0 ]; then job "code, $cc -O2, SPH_SINGLE=$single" $cc -std=c99 "$strict_c" "$more" -O2 "$all" -DSPH_SINGLE=$single -c "$scratch/only_sph.h.c" -o /dev/null; fi
        if [ "$full" ] || [ $single = 1 ]; then
            job "code, $cc -O3 -march=native -ffast-math, SPH_SINGLE=$single" $cc -std=c99 "$strict_c" "$more" -O3 -march=native -ffast-math "$all" -DSPH_SINGLE=$single -c "$scratch/only_sph.h.c" -o /dev/null
        fi
        [ -z "$full" ] || job "code, $cc -O0, SPH_SINGLE=$single" $cc -std=c99 "$strict_c" "$more" -O0 "$all" -DSPH_SINGLE=$single -c "$scratch/only_sph.h.c" -o /dev/null
    done
done
[ "$full" ] && for cxx in g++ clang++; do
    installed $cxx || continue
    if [ $cxx = g++ ]; then more=$strict_gcc; else more=-Wno-pass-failed; fi
    for level in -O0 -O2; do job "code, $cxx $level" $cxx -x c++ -std=c++11 "$strict" "$more" $level "$all" -c "$scratch/only_sph.h.c" -o /dev/null; done
done

# ---------------------------------------------------------------- sources

for cc in gcc clang; do
    installed $cc || continue
    for f in $(ls tests/test_*.c | grep -v -e test_gsl -e test_common); do
        for single in 0 1; do job "$f, $cc, SPH_SINGLE=$single" $cc -std=c99 "$basic" -DSPH_SINGLE=$single -fsyntax-only "$f"; done
    done
    for f in tests/test_common.c tests/embedded/selfcheck.c examples/*.c examples/papers/*.c examples/common/*.c; do
        job "$f, $cc" $cc -std=c99 "$basic" "-I$scratch" -fsyntax-only "$f"
    done
done

# ---------------------------------------------------------------- runs

# pair NAME 'COMPILER OF THE FLOAT PART' 'OF THE DOUBLE PART' 'LINKER' [RUNNER]
pairs=0
pair() {
    pairs=$((pairs + 1))
    part=$scratch/pair$pairs
    job "runs, $1" $2 -I. "-I$scratch" -DSPH_SINGLE=1 -DSELFCHECK_MAIN=check_float -c tests/embedded/selfcheck.c -o "$part.f.o" "&&" \
        $3 -I. "-I$scratch" -DSELFCHECK_MAIN=check_double -c tests/embedded/selfcheck.c -o "$part.d.o" "&&" $4 "$scratch/both.c" "$part.f.o" "$part.d.o" -o "$part.exe" -lm "&&" \
        $5 "$part.exe" ">" "$part.out" "&&" test "\$(grep -c 'selfcheck: [0-9]* passed, 0 failed' $part.out)" = 2
}
fast="-O3 -march=native -ffast-math"
has gcc && has g++ && pair "gcc C99 and g++ C++11, -O1" "gcc -std=c99 -O1 $basic" "g++ -x c++ -std=c++11 -O1 $basic" gcc
has clang && has clang++ && pair "clang C2x and clang++ C++20, -O1" "clang -std=c2x -O1 $basic" "clang++ -x c++ -std=c++20 -O1 $basic" clang
has tcc && pair "tcc" "tcc -Wall -Werror" "tcc -Wall -Werror" tcc
# without optimisation forced inlining is but more code to write: one copy of each function there
once="'-DSPH_FN=static __attribute__((noinline, unused))'"
has musl-gcc && pair "musl, -O0" "musl-gcc -std=c99 $basic $once" "musl-gcc -std=c99 $basic $once" "musl-gcc -static"
has "gcc -m32" && pair "i686, x87, -O0" "gcc -m32 -std=c99 $basic $once" "gcc -m32 -std=c99 $basic $once" "gcc -m32"
if [ "$full" ]; then
    for level in -O0 -O2 "$fast"; do
        for cc in gcc clang; do
            case $cc in gcc) cxx=g++ ;; clang) cxx=clang++ ;; esac
            has $cc && has $cxx && pair "$cc C11 and $cxx C++17, $level" "$cc -std=c11 $level $basic" "$cxx -x c++ -std=c++17 $level $basic" $cc
        done
    done
    has "gcc -m32" && pair "i686, SSE2, -O2" "gcc -m32 -msse2 -mfpmath=sse -std=c99 -O2 $basic" "gcc -m32 -msse2 -mfpmath=sse -std=c99 -O2 $basic" "gcc -m32"
    has musl-gcc && pair "musl, -O2" "musl-gcc -std=c99 -O2 $basic" "musl-gcc -std=c99 -O2 $basic" "musl-gcc -static"
fi
if has x86_64-w64-mingw32-gcc; then
    wine=$(command -v wine64 || ls /usr/lib/wine/wine64 2> /dev/null)
    if [ -z "$wine" ]; then skip "a run under Windows" "wine64 is not installed"; fi
    windows="x86_64-w64-mingw32-gcc -std=c99 -O1 -D__USE_MINGW_ANSI_STDIO=1 $basic"
    pair "mingw-w64${wine:+, by wine}" "$windows" "$windows" x86_64-w64-mingw32-gcc "${wine:+env WINEDEBUG=-all timeout 100 $wine}"
    [ "$wine" ] || sed -i 's/ && [^&]*exe > .*//' "$scratch/jobs/$jobs"
fi

# ---------------------------------------------------------------- all of them

i=0
while [ $i -lt $jobs ]; do
    i=$((i + 1))
    echo $i
done | SCRATCH=$scratch xargs -P "${JOBS:-1}" -n 1 sh -c 'sh "$SCRATCH/jobs/$1" > "$SCRATCH/jobs/$1.log" 2>&1 < /dev/null; echo $? > "$SCRATCH/jobs/$1.status"' job
i=0
while [ $i -lt $jobs ]; do
    i=$((i + 1))
    if [ "$(cat "$scratch/jobs/$i.status")" = 0 ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "failed: $(sed -n '1s/^# //p' "$scratch/jobs/$i"): $(sed -n 2p "$scratch/jobs/$i" | cut -c 1-300)"
        head -n 5 "$scratch/jobs/$i.log"
    fi
done
finish "matrix${full:+ full}"
