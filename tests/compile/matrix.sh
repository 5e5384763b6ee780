#!/bin/sh
# SPDX-License-Identifier: MIT
# What compilers make of the headers, and of every test and example, with warnings as errors.
# Compilers that are not installed, or whose programs do not run here, are skipped aloud.
#     tests/compile/matrix.sh [full]          from the repository root; JOBS=2: two at a time
# headers    alone and all together, double and float, in the oldest and (full: every) newer standard of C and C++; OpenCL C 1.2
# code       every function of the headers compiled, not only parsed, so that warnings that need the optimiser come up, too: -O2, and -O3 -march=native -ffast-math (full: -O0, and both
#            precisions of all)
# sources    every test and example under the same warnings, by one compiler (full: by each)
# calls      one call of every function that takes arrays (calls.sh), which is what users compile: C, in 2D, at -Og;
#            sweeps.sh compiles sweeps at -O2 (full: C and C++, in every dimension and both precisions, from -Og to
#            -Ofast, with -ffast-math and -march=native)
# packages   such calls (full: all of them) in both precisions as one shared library, by the flags of a Linux distribution for
#            packages, with link-time optimisation: Fedora's (full: those of others, too)
# runs       the self-check of tests/embedded, one program of a float part in C and a double part in C or C++:
#            gcc, clang, tcc, musl, i686 (by qemu-i386 where the kernel runs no 32-bit programs), mingw-w64
#            (by wine, where installed)
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
# the compilers that can be used at all
c='' cxx=''
for cc in gcc clang; do usable $cc "$empty" '' "$cc -std=c99 $basic" && c="$c $cc"; done
for cc in g++ clang++; do usable $cc "$empty" '' "$cc -x c++ -std=c++11 $basic" && cxx="$cxx $cc"; done

# what is skipped below depends on the probe: it must tell the ways apart in which it can fail
# shellcheck disable=SC2317
probed() { # WHY RUNNER THAT IS FOUND, RUNS' ARGUMENTS...: why it fails; empty: it does not
    expected=$1 found=$2
    shift 2
    if runs "$@"; then [ -z "$expected" ] && [ "$runner" = "$found" ] && return; fi
    case ${expected:+$why} in *"${expected:-.}"*) return ;; esac
    echo "$runner, $why"
    return 1
}
for cc in $c; do
    none="$cc is installed, but makes no program"
    neither="does not run in false (status 1): it says nothing; no-such-qemu is not installed"
    check "probe: one that runs" probed '' '' "$empty" '' $cc
    check "probe: no such compiler" probed "no-such-cc is not installed" '' "$empty" '' "no-such-cc -O2"
    check "probe: no such flag" probed "$none" '' "$empty" '' "$cc -fno-such-flag"
    check "probe: it ends with 3" probed "does not run (status 3)" '' 'int main(void) { return 3; }' '' $cc
    check "probe: no such emulator" probed "no-such-qemu is not installed" '' "$empty" no-such-qemu $cc
    check "probe: the second" probed '' 'env A=1' "$empty" 'no-such-qemu|false|env A=1' $cc
    check "probe: neither" probed "$neither" '' "$empty" 'false|no-such-qemu' $cc
    break
done

for h in sph_kernels.h sph_ops.h sph.h; do printf '#include "%s"\nint main(void) { return 0; }\n' "$h" > "$scratch/only_$h.c"; done
printf '#include "sph.h"\n#include "sph_kernels.h"\n#include "sph_ops.h"\n#include "sph.h"\nint main(void) { return 0; }\n' > "$scratch/only_all.c"
awk -f tests/embedded/known.awk tests/known/kernels.csv > "$scratch/known_answers.h" || exit 2
printf '#ifdef __cplusplus\nextern "C" {\n#endif\nint check_float(void);\nint check_double(void);\n#ifdef __cplusplus\n}\n#endif\nint main(void) { return check_float() | check_double(); }\n' > "$scratch/both.c"
only="$scratch/only_sph_kernels.h.c $scratch/only_sph_ops.h.c $scratch/only_sph.h.c"

# ---------------------------------------------------------------- headers

for cc in $c; do
    for std in c99 c11 c17 c2x; do
        case $full$std in c11 | c17) continue ;; esac
        usable "headers, $cc, $std" "$empty" '' "$cc -std=$std $strict_c" || continue
        for single in 0 1; do job "headers, $cc, $std, SPH_SINGLE=$single" $cc -std=$std "$strict_c" -DSPH_SINGLE=$single -fsyntax-only "$only"; done
    done
    job "headers together, $cc" $cc -std=c99 "$strict_c" -fsyntax-only "$scratch/only_all.c"
    [ $cc = clang ] || continue
    every="clang -std=c99 $strict_clang -Werror"
    if [ "$full" ] && usable "headers, all warnings of clang" "$empty" '' "$every"; then
        for single in 0 1; do
            job "headers, all warnings of clang, SPH_SINGLE=$single" "$every" -I. -DSPH_SINGLE=$single \
                -fsyntax-only "$scratch/only_all.c"
        done
    fi
    for std in 1.2 3.0; do
        case $full$std in 3.0) continue ;; esac
        cl="clang -x cl -cl-std=CL$std -Xclang -finclude-default-header -Werror"
        # not to be run: that takes a device, and is tests/hosts
        usable "OpenCL C $std" 'kernel void f(global int *x) { x[0] = 1; }' - "$cl" -fsyntax-only || continue
        for single in 0 1; do
            job "OpenCL C $std, SPH_SINGLE=$single" "$cl" -DSPH_SINGLE=$single -I. -include sph_ops.h \
                -fsyntax-only /dev/null
        done
    done
done
for cc in $cxx; do
    for std in c++11 c++14 c++17 c++20; do
        case $full$std in c++14 | c++17) continue ;; esac
        usable "headers, $cc, $std" "$empty" '' "$cc -x c++ -std=$std $strict" || continue
        for single in 0 1; do
            job "headers, $cc, $std, SPH_SINGLE=$single" $cc -x c++ -std=$std "$strict" -DSPH_SINGLE=$single \
                -fsyntax-only "$only"
        done
    done
    job "headers together, $cc" $cc -x c++ -std=c++11 "$strict" -fsyntax-only "$scratch/only_all.c"
done

# ---------------------------------------------------------------- code

# every function kept, once, called by none; clang's hint that a loop of calls was not vectorised says nothing then
all="'-DSPH_FN=static __attribute__((noinline, used))'"
fast="-O3 -march=native -ffast-math"
for cc in $c; do
    if [ $cc = gcc ]; then more=$strict_gcc; else more=-Wno-pass-failed; fi
    for level in -O2 "$fast" ${full:+-O0}; do
        code="$cc -std=c99 $strict_c $more $level"
        usable "code, $cc $level" "$empty" '' "$code" || continue
        for single in 0 1; do
            case $full$single$level in 1-O2 | 0-O3*) continue ;; esac
            job "code, $cc $level, SPH_SINGLE=$single" "$code" "$all" -DSPH_SINGLE=$single \
                -c "$scratch/only_sph.h.c" -o /dev/null
        done
    done
done
[ "$full" ] && for cc in $cxx; do
    if [ $cc = g++ ]; then more=$strict_gcc; else more=-Wno-pass-failed; fi
    for level in -O0 -O2; do
        code="$cc -x c++ -std=c++11 $strict $more $level"
        usable "code, $cc $level" "$empty" '' "$code" || continue
        job "code, $cc $level" "$code" "$all" -c "$scratch/only_sph.h.c" -o /dev/null
    done
done

# ---------------------------------------------------------------- calls

dims=2
[ "$full" ] && dims="1 2 3"
# shellcheck disable=SC2086
sh tests/compile/calls.sh double . $dims > "$scratch/double.c"
# shellcheck disable=SC2086
sh tests/compile/calls.sh float . $dims > "$scratch/float.c"
check "there are calls of all functions" test "$(grep -c 'return sph_' "$scratch/double.c")" -ge $((full ? 170 : 65))
called="-Wall -Wextra -Werror -I. -c -o /dev/null"
user() { # COMPILER LEVEL
    usable "calls, $1 $2" "$empty" '' "$1 $2" || return
    job "calls, $1 $2" "$1 $2 $called $scratch/double.c"
    [ -z "$full" ] || job "calls, $1 $2, SPH_SINGLE=1" "$1 $2 $called -DSPH_SINGLE=1 $scratch/float.c"
}
[ "$full" ] || user "gcc -std=c99" -Og
[ "$full" ] && for cc in "gcc -std=c99" "clang -std=c99" "g++ -x c++ -std=c++11" "clang++ -x c++ -std=c++11"; do
    for level in -Og -O2 "-O2 -ffast-math" "-O2 -march=native -fopenmp-simd -DSPH_SIMD=1" -O3 "-O3 -march=native" \
        "-O3 -march=native -ffast-math" -Ofast; do user "$cc" "$level"; done
done

# ---------------------------------------------------------------- packages

few=. # all of them take the optimiser minutes at link time
[ "$full" ] || few=sph_derivatives_icspm
# shellcheck disable=SC2086
for p in double float; do sh tests/compile/calls.sh $p "$few" $dims > "$scratch/library_$p.c"; done
# distribution NAME COMPILER 'FLAGS' 'FLAGS OF THE LINKER', with its warnings as errors
distribution() {
    usable "packages, $1, $2" "$empty" '' "$2" $3 -Werror -fPIC $4 || return
    lib=$scratch/$(echo "$1-$2" | tr -c 'a-z0-9A-Z\n' _)
    job "packages, $1, $2" "$2 $3 -Werror -fPIC -I. -c $scratch/library_double.c -o $lib.d.o &&" \
        "$2 $3 -Werror -fPIC -I. -DSPH_SINGLE=1 -c $scratch/library_float.c -o $lib.f.o &&" \
        "$(echo "$2" | sed 's/ -x c++//') $3 -Werror $4 -shared $lib.d.o $lib.f.o -o $lib.so -lm"
}
fortify=-D_FORTIFY_SOURCE=3
for cc in "gcc -std=gnu11" "g++ -x c++" "clang -std=gnu11" "clang++ -x c++"; do
    lto="-flto=auto -ffat-lto-objects"
    case $full$cc in
    g* | 1g*) ;;
    1*) lto="-flto=thin -fuse-ld=lld" ;;
    *) continue ;;
    esac
    distribution Fedora "$cc" "-O2 $lto -fexceptions -g -pipe -Wall -Wextra -Werror=format-security
        -Wp,-U_FORTIFY_SOURCE,$fortify -Wp,-D_GLIBCXX_ASSERTIONS -fstack-protector-strong -m64
        -fasynchronous-unwind-tables -fstack-clash-protection -fcf-protection -fno-omit-frame-pointer" \
        "-Wl,-z,relro -Wl,--as-needed -Wl,-z,now"
    [ "$full" ] || continue
    distribution "Debian, hardening=+all" "$cc" "-g -O2 -fstack-protector-strong -fstack-clash-protection -Wall
        -Wformat -Werror=format-security -fcf-protection -Wdate-time -D_FORTIFY_SOURCE=2" "-Wl,-z,relro -Wl,-z,now"
    distribution "Ubuntu" "$cc" "-g -O2 $lto -fstack-protector-strong -fstack-clash-protection -Wall -Wformat
        -Werror=format-security -fcf-protection -U_FORTIFY_SOURCE $fortify" "-Wl,-z,relro -Wl,-Bsymbolic-functions"
    distribution "openSUSE" "$cc" "-O2 -Wall -U_FORTIFY_SOURCE $fortify -fstack-protector-strong -funwind-tables
        -fasynchronous-unwind-tables -fstack-clash-protection -Werror=return-type $lto -g" -Wl,--as-needed
    distribution "Arch" "$cc" "-march=x86-64 -mtune=generic -O2 -pipe -fno-plt -fexceptions -Wall -Wformat
        -Werror=format-security -Wp,-U_FORTIFY_SOURCE,$fortify -fstack-clash-protection -fcf-protection
        -fno-omit-frame-pointer $lto" "-Wl,-O1 -Wl,--sort-common -Wl,--as-needed -Wl,-z,relro -Wl,-z,now"
    case $cc in g*) distribution "Gentoo, strict" "$cc" "-O2 $lto -Wall -Werror=odr -Werror=lto-type-mismatch
        -Werror=strict-aliasing" '' ;; esac
done
[ "$full" ] && distribution "Alpine" "musl-gcc -std=c99" "-Os -Wall -Wformat -Werror=format-security
    -fstack-clash-protection -fstack-protector-strong -flto" "-Wl,--as-needed -Wl,-O1"

# ---------------------------------------------------------------- sources

some=${c##* }
[ "$full" ] && some=$c
for cc in $some; do
    for f in $(ls tests/test_*.c | grep -v -e test_gsl -e test_common); do
        for single in 0 1; do job "$f, $cc, SPH_SINGLE=$single" $cc -std=c99 "$basic" -DSPH_SINGLE=$single -fsyntax-only "$f"; done
    done
    for f in tests/test_common.c tests/embedded/selfcheck.c examples/*.c examples/[!h]*/*.c; do
        job "$f, $cc" $cc -std=c99 "$basic" "-I$scratch" -fsyntax-only "$f"
    done
done

# ---------------------------------------------------------------- runs

# pair NAME 'COMPILER OF THE FLOAT PART' 'OF THE DOUBLE PART' LINKER 'ITS FLAGS' [RUNNERS]
pairs=0
pair() {
    for compiler in "$2" "$3"; do
        usable "runs, $1" "$empty" "${6-}" "$compiler" $5 -lm || return
    done
    pairs=$((pairs + 1))
    part=$scratch/pair$pairs
    flags="-I. -I$scratch -c tests/embedded/selfcheck.c"
    both="test \$(grep -c 'selfcheck: [0-9]* passed, 0 failed' $part.out) = 2"
    run="&& $bounded $runner $part.exe > $part.out && $both"
    if [ "$runner" = - ]; then
        skip "runs, $1: built, but not run" "$why"
        run=
    fi
    job "runs, $1" "$2 -DSPH_SINGLE=1 -DSELFCHECK_MAIN=check_float $flags -o $part.f.o &&" \
        "$3 -DSELFCHECK_MAIN=check_double $flags -o $part.d.o &&" \
        "$4 $5 $scratch/both.c $part.f.o $part.d.o -o $part.exe -lm $run"
}
pair "gcc C99 and g++ C++11, -O1" "gcc -std=c99 -O1 $basic" "g++ -x c++ -std=c++11 -O1 $basic" gcc ''
pair "clang C2x and clang++ C++20, -O1" \
    "clang -std=c2x -O1 $basic" "clang++ -x c++ -std=c++20 -O1 $basic" clang ''
pair "tcc" "tcc -Wall -Werror" "tcc -Wall -Werror" tcc ''
# without optimisation forced inlining is but more code to write
echo '#define SPH_FN static inline' > "$scratch/inlining.h" # $freely has a space
inlining="-include $scratch/inlining.h"
musl="musl-gcc -std=c99 $basic"
i686="gcc -m32 -std=c99 $basic"
pair "musl, -O0" "$musl $inlining" "$musl $inlining" musl-gcc -static
pair "i686, x87, -O1" "$i686 -O1 $inlining" "$i686 -O1 $inlining" gcc -m32 '|qemu-i386'
if [ "$full" ]; then
    for level in -O0 -O2 "$fast"; do
        for cc in gcc clang; do
            case $cc in gcc) with_cxx=g++ ;; clang) with_cxx=clang++ ;; esac
            pair "$cc C11 and $with_cxx C++17, $level" "$cc -std=c11 $level $basic" \
                "$with_cxx -x c++ -std=c++17 $level $basic" $cc ''
        done
    done
    sse="$i686 -msse2 -mfpmath=sse -O2"
    pair "i686, SSE2, -O2" "$sse" "$sse" gcc -m32 '|qemu-i386'
    pair "musl, -O2" "$musl -O2" "$musl -O2" musl-gcc -static
fi
windows="x86_64-w64-mingw32-gcc -std=c99 -O1 -D__USE_MINGW_ANSI_STDIO=1 $basic"
export WINEDEBUG=-all
pair "mingw-w64" "$windows" "$windows" x86_64-w64-mingw32-gcc '' 'wine64|/usr/lib/wine/wine64|wine|-'

# ---------------------------------------------------------------- all of them

numbers=$(awk -v jobs=$jobs 'BEGIN { for (i = 1; i <= jobs; i++) print i }')
# shellcheck disable=SC2086
sh examples/common/progress.sh "matrix${full:+-full}" "$scratch/jobs/*.status" $numbers &
watcher=$!
echo "$numbers" | SCRATCH=$scratch xargs -P "${JOBS:-1}" -n 1 sh -c 'sh "$SCRATCH/jobs/$1" > "$SCRATCH/jobs/$1.log" 2>&1 < /dev/null; echo $? > "$SCRATCH/jobs/$1.status"' job
kill $watcher 2> /dev/null
wait $watcher
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
