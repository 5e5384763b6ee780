#!/bin/sh
# SPDX-License-Identifier: MIT
#
# folding.sh - read the assembly: does a kernel with constant arguments fold?
#
#     tests/compile/folding.sh [COMPILER...]      default: gcc clang; from the repository root
#
# For every kernel in sph_kernels.h, 1 to 3 dimensions, W and F, a function that writes an array and one that sums.
#   folding        -O2: no call, no indirect jump (the jump table of a switch), no chain of comparisons in its stead
#   vectorisation  gcc -O3, clang -O2: packed multiplications in the function that writes an array; in float for 2 dimensions only, to save time
# Vectorisation is looked at on x86-64 only, folding there and on AArch64.
#
# Excluded, because the loop has to call a function:
#   SPH_GAUSSIAN, SPH_SUPER_GAUSSIAN   exp; plain -O2 and -O3 know no vector exp (glibc's libmvec wants -ffast-math)
#
# The detector itself is tested, too, on functions that must not pass.

. tests/check.sh
set -u
LC_ALL=C
export LC_ALL

calls_exp='SPH_GAUSSIAN SPH_SUPER_GAUSSIAN'

[ -f sph_kernels.h ] || { echo "folding: sph_kernels.h not found: run from the repository root" >&2; exit 1; }
[ $# -gt 0 ] || set -- gcc clang

kernels=
for id in $(sed -n 's/^ *each(context, \(SPH_[A-Z0-9_]*\), *".*/\1/p' sph_kernels.h); do
    case " $calls_exp " in
    *" $id "*) ;;
    *) kernels="$kernels $id" ;;
    esac
done
[ -n "$kernels" ] || { echo "folding: no kernels found in sph_kernels.h" >&2; exit 1; }

# Functions named write_KERNEL_w_DIM, sum_KERNEL_w_DIM, ..., and control_*, which the detector must object to.
source=$scratch/folding.c
{
    echo '#include "sph_kernels.h"'
    echo '#define WRITES(K, DIM, V) \'
    echo '    void write_##K##_##V##_##DIM(const sph_real *SPH_RESTRICT r, sph_real *SPH_RESTRICT out, sph_real h, int n); \'
    echo '    void write_##K##_##V##_##DIM(const sph_real *SPH_RESTRICT r, sph_real *SPH_RESTRICT out, sph_real h, int n) \'
    echo '    { int i; for (i = 0; i < n; i++) out[i] = sph_kernel_##V(K, DIM, r[i], h); }'
    echo '#define SUMS(K, DIM, V) \'
    echo '    sph_real sum_##K##_##V##_##DIM(const sph_real *r, sph_real h, int n); \'
    echo '    sph_real sum_##K##_##V##_##DIM(const sph_real *r, sph_real h, int n) \'
    echo '    { int i; sph_real s = 0; for (i = 0; i < n; i++) s += sph_kernel_##V(K, DIM, r[i], h); return s; }'
    for id in $kernels; do
        for dim in 1 2 3; do
            # -DFOLDING_PART=1: all but the sums; 2: of that, what the float run looks at
            [ "$dim" = 2 ] || echo '#if FOLDING_PART < 2'
            echo "WRITES($id, $dim, w)"
            echo "WRITES($id, $dim, f)"
            [ "$dim" = 2 ] || echo '#endif'
            echo '#if FOLDING_PART < 1'
            echo "SUMS($id, $dim, w)"
            echo "SUMS($id, $dim, f)"
            echo '#endif'
        done
    done
    echo 'sph_real control_switch(const sph_real *r, sph_real h, int n, sph_kernel k);'
    echo 'sph_real control_switch(const sph_real *r, sph_real h, int n, sph_kernel k)'
    echo '{ int i; sph_real s = 0; for (i = 0; i < n; i++) s += sph_kernel_f(k, 3, r[i], h); return s; }'
    echo 'void control_call(const sph_real *SPH_RESTRICT r, sph_real *SPH_RESTRICT out, sph_real h, int n);'
    echo 'void control_call(const sph_real *SPH_RESTRICT r, sph_real *SPH_RESTRICT out, sph_real h, int n)'
    echo '{ int i; for (i = 0; i < n; i++) out[i] = sph_kernel_w(SPH_GAUSSIAN, 3, r[i], h); }'
} >"$source"

# Prints "NAME calls indirect conditional packed" of every function in an assembly file.
count()
{
    awk '
        function finish() { if (name != "") print name, calls, indirect, conditional, packed }
        /^_?(write_SPH|sum_SPH|control)_[A-Za-z0-9_]*:/ {
            finish()
            name = $1; sub(/^_/, "", name); sub(/:.*/, "", name)
            calls = indirect = conditional = packed = 0
            next
        }
        { op = $1; if (op == "notrack" || op == "bnd") { op = $2; arguments = $3 } else arguments = $2 }
        op ~ /^(call|callq|bl|blr)$/ { calls++; next }
        # a jump that leaves the function is a call, too
        op ~ /^(jmp|jmpq)$/ && arguments ~ /^\*/ { indirect++; next }
        op ~ /^(jmp|jmpq|b)$/ && arguments !~ /^\.?L/ { calls++; next }
        op == "br" { indirect++; next }
        op ~ /^j[a-z]+$/ && op !~ /^jmp/ || op ~ /^(b\..*|cbn?z|tbn?z)$/ { conditional++; next }
        op ~ /^v?mulp[sd]$/ { packed++ }
        END { finish() }
    ' "$1"
}

fail()
{
    failed=$((failed + 1))
    echo "folding: failed: $*" >&2
}

for cc in "$@"; do
    # a COMPILER of several words is a command with its options
    set -f
    # shellcheck disable=SC2086
    set -- $cc
    set +f
    # not run: only its assembly is read, which a compiler for another processor writes as well
    usable "folding by $cc" "$empty" - "$cc" -std=c99 -O2 -S || continue
    machine=$("$@" -dumpmachine 2>/dev/null)
    case $machine in
    x86_64* | amd64*) x86=1 ;;
    aarch64* | arm64*) x86=0 ;;
    *)
        skip "folding by $cc" "this test cannot read the assembly of ${machine:-an unknown machine}"
        continue
        ;;
    esac
    if "$@" --version 2>/dev/null | grep -q clang; then family=clang level=-O2; else family=gcc level=-O3; fi

    asm=$scratch/folding.s
    if ! "$@" -std=c99 -O2 -DFOLDING_PART=0 -I. -S "$source" -o "$asm"; then
        fail "$cc does not compile $source"
    else
        count "$asm" >"$scratch/counts"
        # Besides the loops themselves and their remainders nothing branches: 16 conditional jumps are ample for them, and far fewer than a chain of 20 comparisons
        # in every switch of a kernel that has not been folded.
        for id in $kernels; do
            for form in write sum; do
                for value in w f; do
                    for dim in 1 2 3; do
                        name=${form}_${id}_${value}_$dim
                        echo "$name"
                    done
                done
            done
        done >"$scratch/names"
        verdict=$(awk '
            NR == FNR { calls[$1] = $2; indirect[$1] = $3; conditional[$1] = $4; next }
            !($1 in calls) { print "failed " $1 " is not in the assembly"; next }
            calls[$1] + 0 > 0 { print "failed " $1 " calls a function"; next }
            indirect[$1] + 0 > 0 { print "failed " $1 " has an indirect jump"; next }
            conditional[$1] + 0 > 16 { print "failed " $1 " has " conditional[$1] " conditional jumps"; next }
            { print "passed" }
        ' "$scratch/counts" "$scratch/names")
        passed=$((passed + $(printf '%s\n' "$verdict" | grep -c '^passed')))
        failed=$((failed + $(printf '%s\n' "$verdict" | grep -c '^failed')))
        printf '%s\n' "$verdict" | sed -n "s/^failed/folding $cc -O2: failed:/p" >&2

        if awk '$1 == "control_switch" && ($3 > 0 || $4 > 16) { found = 1 } END { exit !found }' "$scratch/counts"; then
            passed=$((passed + 1))
        else
            fail "$cc -O2: a kernel chosen at run time was not seen to branch"
        fi
        if awk '$1 == "control_call" && $2 > 0 { found = 1 } END { exit !found }' "$scratch/counts"; then
            passed=$((passed + 1))
        else
            fail "$cc -O2: the call of exp was not seen"
        fi
    fi

    if [ "$x86" = 0 ]; then
        skip "vectorisation by $cc" "it is looked for on x86-64 only"
    else
        for single in 0 1; do
            if [ $single = 0 ]; then part=1 dims='1 2 3'; else part=2 dims=2; fi
            # in double at -O2 the assembly is already there
            if [ $single$level != 0-O2 ]; then
                if ! "$@" -std=c99 $level -DSPH_SINGLE=$single -DFOLDING_PART=$part -I. -S "$source" -o "$asm"; then
                    fail "$cc does not compile $source with -DSPH_SINGLE=$single"
                    continue
                fi
                count "$asm" >"$scratch/counts"
            fi
            for id in $kernels; do
                for value in w f; do
                    for dim in $dims; do
                        echo "write_${id}_${value}_$dim"
                    done
                done
            done >"$scratch/names"
            verdict=$(awk '
                NR == FNR { packed[$1] = $5; next }
                packed[$1] + 0 > 0 { print "passed"; next }
                { print "failed " $1 " does not vectorise" }
            ' "$scratch/counts" "$scratch/names")
            passed=$((passed + $(printf '%s\n' "$verdict" | grep -c '^passed')))
            failed=$((failed + $(printf '%s\n' "$verdict" | grep -c '^failed')))
            printf '%s\n' "$verdict" | sed -n "s/^failed/folding $cc $level -DSPH_SINGLE=$single: failed:/p" >&2
            if awk '$1 == "control_call" && $5 == 0 { found = 1 } END { exit !found }' "$scratch/counts"; then
                passed=$((passed + 1))
            else
                fail "$cc $level -DSPH_SINGLE=$single: the loop that calls exp was seen as vectorised"
            fi
        done
    fi
done
finish folding
