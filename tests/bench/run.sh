#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds bench.c in several variants (compiler, flags, precision) into $BUILD/bench, runs them one after the other, and ends with a table of the targets.
#     sh tests/bench/run.sh            from the root of the repository; some minutes on two idle cores, a minute or two of them to build what has changed
#     sh tests/bench/run.sh -full      up to 4e6 particles, more rounds, float everywhere
# $BUILD/bench/bench.csv has all figures, targets.csv the targets. A missed target is no failure; a variant that does not build or stops with an error is.
# GCC, CLANG and CXX name the compilers. Figures move with what else the machine does: compare ratios, and within one run.
LC_ALL=C
export LC_ALL
. tests/check.sh
GCC=${GCC:-gcc}
CLANG=${CLANG:-clang}
CXX=${CXX:-g++}
dir=$BUILD/bench
source=tests/bench/bench.c
full=0
case $1 in
-full) full=1 ;;
'') ;;
*)
    echo "usage: sh tests/bench/run.sh [-full]" >&2
    exit 2
    ;;
esac
mkdir -p "$dir" || exit 2
csv=$dir/bench.csv
targets=$dir/targets.csv
log=$dir/build.log
# defines MACRO COMPILER FLAGS ...
defines() {
    macro=$1
    shift
    : > "$dir/empty.c"
    "$@" -dM -E "$dir/empty.c" 2> /dev/null | grep -q "define $macro "
}

nanoflann=
if printf '#include <nanoflann.hpp>\n' > "$dir/has.cpp" && installed "$CXX" && $CXX -E "$dir/has.cpp" > /dev/null 2>&1; then
    native=-march=native
    $CXX $native -E "$dir/has.cpp" > /dev/null 2>&1 || native=
    nanoflann=$dir/nanoflann.o
    if [ -z "$(find tests/bench/nanoflann.cpp -newer "$nanoflann" 2>&1)" ]; then
        : # it is up to date
    elif ! $CXX -O3 $native -DNDEBUG -c tests/bench/nanoflann.cpp -o "$dir/nanoflann.o" 2> "$log"; then
        nanoflann=
        echo "tests/bench/nanoflann.cpp does not compile:"
        head -n 20 "$log"
        failed=1
    fi
else
    skip "the comparison with nanoflann" "it is not installed (Debian: libnanoflann-dev)"
fi
cores=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)
[ "$cores" -ge 2 ] || skip "two threads" "there is one core"

# build PROGRAM EXTRAS COMPILER FLAGS ...: the forms of the code that bench.c describes, in one program. EXTRAS: 2d, variable, avx2, omp
build() (
    program=$dir/$1
    extras=" $2 "
    shift 2
    wants() { case $extras in *" $1 "*) ;; *) return 1 ;; esac }
    if [ -x "$program" ] && [ -z "$(find sph.h sph_ops.h sph_kernels.h tests/bench $nanoflann -newer "$program")" ]; then return 0; fi
    objects=
    # part NAME COMPILER FLAGS ...
    part() {
        o=$program-$1.o
        shift
        "$@" -c "$source" -o "$o" || exit 1
        objects="$objects $o"
    }
    set -- "$@" -std=c99 -Wall -Wextra -Wpedantic -I.
    have=
    links=
    more=
    wants 2d && more=-DBENCH_2D=1
    part ops "$@" $more -DBENCH_OPS=ops_main -DSPH_CHECK=0
    if wants variable; then
        have="$have -DHAVE_VARIABLE=1"
        more="$more -DBENCH_VARIABLE=1"
    fi
    part search "$@" $more -DBENCH_SEARCH=search_main
    if defines __AVX2__ "$@"; then
        have="$have -DHAVE_PORTABLE=1"
        part portable "$@" -DBENCH_SEARCH=search_portable -DSPH_AVX512=0 -DSPH_AVX2=0
        if wants avx2 && defines __AVX512VL__ "$@"; then
            have="$have -DHAVE_AVX2=1"
            part avx2 "$@" -DBENCH_SEARCH=search_avx2 -DSPH_AVX512=0
        fi
    fi
    part checked "$@" -DBENCH_OPS=ops_checked -DSPH_CHECK=1
    if wants omp; then
        have="$have -DHAVE_OPENMP=1"
        links="$links -fopenmp"
        part search-omp "$@" -fopenmp -DSPH_OPENMP=1 -DBENCH_SEARCH=search_omp
        part ops-omp "$@" -fopenmp -DBENCH_OPS=ops_omp -DSPH_CHECK=0
    fi
    if [ -n "$nanoflann" ]; then
        have="$have -DHAVE_NANOFLANN=1"
        links="$nanoflann -lstdc++ $links"
    fi
    part driver "$@" $have
    "$@" -o "$program" $objects $links -lm || exit 1
)

# Variants are numbered as they are met; the first pass builds them side by side, the second runs them.
# variant NAME THOROUGH COMPILER FLAGS ...      THOROUGH: 1: the whole range of sizes, threads, float, 2D; ops: the operators only are
# compiled otherwise than in another variant, and 1e6 is left out, where the search is timed
variants() {
    $1 "gcc -O2" 0 "$GCC" -O2
    $1 "gcc -O3 native simd" 1 "$GCC" -O3 -march=native -fopenmp-simd -DSPH_SIMD=1
    $1 "gcc -O2 simd" ops "$GCC" -O2 -fopenmp-simd -DSPH_SIMD=1
    $1 "gcc -O3 native associative" ops "$GCC" -O3 -march=native -fno-trapping-math -fno-signed-zeros -fassociative-math
    $1 "clang -O2" 0 "$CLANG" -O2
    $1 "clang -O2 native" 1 "$CLANG" -O2 -march=native
}
count=0
build_variant() {
    name=$1
    thorough=$2
    shift 2
    count=$((count + 1))
    rm -f "$dir/$count.skipped"
    if ! runs "$empty" '' "$@"; then
        skip "$name" "$why"
        : > "$dir/$count.skipped"
        return
    fi
    extras=
    if [ "$thorough" = 1 ]; then
        [ $full = 1 ] || [ $count = 2 ] && extras="variable 2d avx2"
        if [ "$cores" -lt 2 ]; then
            :
        elif runs "#include <omp.h>\nint main(void) { omp_set_num_threads(2); return 0; }" '' "$@" -fopenmp; then
            extras="$extras omp"
        else
            skip "$name, two threads" "$why"
        fi
    fi
    # another set of forms is another program
    suffix=
    [ $full = 1 ] && suffix=-full
    (build "$count-double$suffix" "$extras" "$@" || rm -f "$dir/$count-double$suffix") > "$dir/$count-double$suffix.log" 2>&1 &
    if [ $full = 0 ]; then
        extras=
        [ $count = 2 ] || return
    fi
    (build "$count-float$suffix" "$extras" "$@" -DSPH_SINGLE=1 || rm -f "$dir/$count-float$suffix") > "$dir/$count-float$suffix.log" 2>&1 &
}
# run PROGRAM NAME OPTIONS ...
run() {
    program=$1
    name=$2
    shift 2
    if [ ! -x "$dir/$program" ]; then
        echo "$name: $program was not built:"
        head -n 20 "$dir/$program.log"
        failed=1
        return
    fi
    "$dir/$program" -name "$name" -csv "$csv" -targets "$targets" "$@" || failed=1
}
run_variant() {
    name=$1
    thorough=$2
    count=$((count + 1))
    [ -f "$dir/$count.skipped" ] && return
    if [ $full = 1 ] && [ "$thorough" = 1 ]; then
        for precision in double float; do
            run $count-$precision-full "$name" -full -dim 3 -n 1e4,1e5,1e6,4e6
            run $count-$precision-full "$name" -full -dim 2 -n 1e4,1e5,1e6,4e6
        done
    elif [ $full = 1 ]; then
        run $count-double-full "$name" -dim 3 -n 1e4,1e5,1e6
        run $count-float-full "$name" -dim 3 -n 1e4,1e5,1e6
    elif [ "$thorough" = 1 ]; then
        run $count-double "$name" -dim 3 -n 1e4,1e5,1e6
        if [ $count = 2 ]; then
            run $count-double "$name" -dim 2 -n 1e4,1e6
            run $count-float "$name" -brief -dim 3 -n 1e5,1e6
        fi
    elif [ "$thorough" = ops ]; then
        run $count-double "$name" -brief -dim 3 -n 1e5
    else
        run $count-double "$name" -brief -dim 3 -n 1e5,1e6
    fi
}

echo "building in $dir (a minute or two where a header has changed) ..."
variants build_variant
wait
count=0
columns=variant,precision,dim,n,storage,what,path,threads,rounds,ns_per_particle,ns_per_interaction,ratio_to_wf,ratio_to_nanoflann,spread
echo "$columns,bytes_per_particle,gb_per_s" > "$csv"
echo "variant,precision,target,value,relation,limit,verdict" > "$targets"
[ -r /proc/loadavg ] && echo "load of the machine before the first run (what it has beside us slows two threads most): $(cut -d ' ' -f 1-3 /proc/loadavg)"
variants run_variant

# Whole steps: the dam break of examples/papers by (5.23), (5.24) with collisions, neighbour lists kept under a skin of 0.3 particle distances. CPU time of a fluid particle and step, everything included; the shortest of three.
# dam NAME THOROUGH COMPILER FLAGS ...
dam() {
    name=$1
    shift 2
    runs "$empty" '' "$@" || return
    if ! "$@" -std=c99 -Wall -Wextra -Wpedantic -o "$dir/dam" examples/papers/clustering_dam.c -lm 2> "$log"; then
        echo "$name: examples/papers/clustering_dam.c does not compile:"
        head -n 20 "$log"
        failed=1
        return
    fi
    for round in 1 2 3; do
        "$dir/dam" -kernel wendland-c2-1d -remedy sequential -dref 0.01 -dt 1e-4 -tend 0.03 -out "$dir" -figures "$dir" -quiet > "$log" || failed=1
        cat "$dir/clustering_dam.csv"
    done | awk -F, -v name="$name" -v csv="$csv" '
    $3 ~ /^CPU time of a particle/ && (!us || $5 < us) { us = $5 }
    $3 ~ /^CPU time of a particle/ && $5 > most { most = $5 }
    $3 == "fluid particles" { n = $5 }
    $3 ~ /neighbour list lasts/ { steps = $5 }
    END {
        if (!us) exit 1
        printf "  %-30s %.3f us of CPU per particle and step (spread %.0f %%); %d particles, a list lasts %.1f steps\n", name, us, 100 * (most / us - 1), n, steps
        printf "%s,double,2,%d,lattice,dam break step,,1,3,%.4g,,,,%.3g,,\n", name, n, 1000 * us, most / us - 1 >> csv
    }' || failed=1
}
printf '\n======== a dam break, whole steps\n'
variants dam

# one line per target, one column per variant
awk -F, '
NR > 1 {
    column = $1 ", " $2
    row = $3 " " $5 " " $6
    if (!(column in known)) { known[column] = 1; columns[++nc] = column }
    if (!(row in seen)) { seen[row] = 1; rows[++nr] = row }
    cell[row, column] = $4 " " ($7 == "missed" ? "MISSED" : $7)
}
END {
    printf "\n======== targets (value and verdict)\n"
    for (c = 1; c <= nc; c++) printf "  [%d] %s\n", c, columns[c]
    printf "\n  %-64s", ""
    for (c = 1; c <= nc; c++) printf "%14s", "[" c "]"
    printf "\n"
    for (r = 1; r <= nr; r++) {
        printf "  %-64s", rows[r]
        for (c = 1; c <= nc; c++) printf "%14s", (rows[r], columns[c]) in cell ? cell[rows[r], columns[c]] : "-"
        printf "\n"
    }
}' "$targets"
echo
echo "all figures: $csv"
[ $failed -eq 0 ]
