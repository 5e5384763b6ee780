#!/bin/sh
# SPDX-License-Identifier: MIT
usage='usage: sh tests/bench/run.sh [speed|flags|compile] [OPTIONS]     from the root of the repository
    speed      the search beside other codes, the operators beside the limits of the machine (make bench)
    flags      what compilers and flags are worth (make bench-flags)
    compile    seconds of compilation and bytes of code (make bench-compile)
    -n LIST         numbers of particles, as in 1e4,1e5,1e6. Default: 1e5; flags: 64000
    -rounds N       how often everything is timed, in turns: the shortest time counts. Default: 5
    -clouds LIST    of lattice, periodic, surface, plummer, plummer-h, nested. Default: all. For speed
    -flags TEXT     for speed. Default: "-O3 -march=x86-64-v3 -fopenmp-simd -DSPH_SIMD=1", where $CC and the
                    processor know that, or -march=native, or without what $CC lacks
    -keep           write the tables to tests/bench/results, too, and those of flags into README.md
Programs, lines of figures (CSV) and tables (Markdown) go to $BUILD/bench. CC is the compiler of speed, GCC and
CLANG are those of flags and compile, CXX is for the other codes. What those are, and how they are found:
tests/bench/README.md.'
LC_ALL=C
export LC_ALL
command="sh tests/bench/run.sh $*"
mode=speed
case ${1:-} in speed | flags | compile)
    mode=$1
    shift
    ;;
esac
sizes='' rounds=5 clouds=lattice,periodic,surface,plummer,plummer-h,nested flags='' keep=''
while [ $# -gt 0 ]; do
    case $1 in
    -n | -rounds | -clouds | -flags)
        [ $# -gt 1 ] || { echo "$usage" >&2; exit 2; }
        case $1 in -n) sizes=$2 ;; -rounds) rounds=$2 ;; -clouds) clouds=$2 ;; -flags) flags=$2 ;; esac
        shift
        ;;
    -keep) keep=1 ;;
    *) echo "$usage" >&2; exit 2 ;;
    esac
    shift
done
. tests/check.sh
GCC=${GCC:-gcc}
CLANG=${CLANG:-clang}
CXX=${CXX:-g++}
dir=$BUILD/bench
mkdir -p "$dir" || exit 2
csv=$dir/$mode.csv
table=$dir/$mode.md
log=$dir/log
source=tests/bench/bench.c
simd="-fopenmp-simd -DSPH_SIMD=1"
load=$(sed 's/ .*//' /proc/loadavg 2> /dev/null)
cores=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 1)
warn="-std=c99 -Wall -Wextra -Wpedantic -I."

broke() { # WHAT: it does not compile or run; $log says why
    echo "failed: $1:"
    head -n 20 "$log"
    failed=1
}
# heading TITLE COMPILER ...: what was measured where
heading() {
    title=$1
    shift
    model=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2> /dev/null | head -n 1)
    commit=$(git rev-parse --short HEAD 2> /dev/null)
    [ -z "$commit" ] || git diff --quiet HEAD -- sph.h sph_ops.h sph_kernels.h 2> /dev/null || commit="$commit and changes"
    echo "# $title"
    echo
    echo "Written by \`$command\` on $(date -u +%Y-%m-%d)${commit:+, with the headers of commit $commit}."
    echo
    echo "* machine: ${model:-$(uname -m)}, $cores cores, $(uname -s)${load:+; load before the run $load}"
    for compiler in "$@"; do
        installed "${compiler%% *}" && echo "* \`$compiler\`: $($compiler --version 2> /dev/null | head -n 1)"
    done
    echo
}
# object NAME WORDS ...: compiles one object file; answers failure, with $log, if it does not
object() {
    object=$dir/$1
    shift
    "$@" -c -o "$object.o" > "$object.log" 2>&1 && return
    mv "$object.log" "$log"
    return 1
}
# program NAME PEERS OBJECTS COMPILER ...: the driver with the forms main and $forms, linked
program() {
    program=$1 with=$2 objects=$3
    shift 3
    object "$program-driver" "$@" $warn "-DBENCH_FORMS=F(main) $forms" "-DBENCH_PEERS=$with" $source &&
        "$@" -o "$dir/$program" "$dir/$program-driver.o" $objects -lm > "$log" 2>&1
}

# ---------------------------------------------------------------- speed

# adapter NAME SINGLE WORDS ...: builds the adapter of another code; $peers and $peer_objects grow
adapter() {
    adapter=$1 single=$2
    shift 2
    if object "peer-$adapter-$single" $CXX -O3 $native -DNDEBUG -DSPH_SINGLE="$single" "$@" "tests/bench/$adapter.cpp"; then
        peers="$peers P($adapter)"
        peer_objects="$peer_objects $dir/peer-$adapter-$single.o"
    else
        broke "tests/bench/$adapter.cpp does not compile"
        return 1
    fi
}
skip_once() { [ "$single" = 1 ] || skip "$@"; } # the second precision lacks the same
# sources TITLE VARIABLE WHERE: succeeds, with $folder, if the variable names a folder
sources() {
    eval "folder=\${$2:-}"
    if [ -z "$folder" ]; then
        skip_once "the comparison with $1" "$2 does not name its sources ($3)"
    elif ! [ -d "$folder" ]; then
        skip_once "the comparison with $1" "there is no folder $folder, which $2 names"
    else return 0; fi
    return 1
}
others() { # SINGLE: all other codes that are here
    single=$1 peers='' peer_objects='' native=''
    if ! installed "$CXX"; then
        skip_once "the comparison with other codes" "$CXX is not installed"
        return
    fi
    printf 'int main() {}\n' > "$dir/has.cpp"
    $CXX -march=native -E "$dir/has.cpp" > /dev/null 2>&1 && native=-march=native
    printf '#include <nanoflann.hpp>\n' > "$dir/has.cpp"
    if $CXX -E "$dir/has.cpp" > /dev/null 2>&1; then
        adapter nanoflann "$single" -std=c++11
    else
        skip_once "the comparison with nanoflann" "it is not installed (Debian: libnanoflann-dev)"
    fi
    if sources TreeNSearch SPH_BENCH_TREENSEARCH https://github.com/InteractiveComputerGraphics/TreeNSearch; then
        set -- -std=c++17 -fopenmp -I"$folder/TreeNSearch/include" -I"$folder/TreeNSearch/extern"
        if adapter treensearch "$single" "$@"; then
            object "treensearch-$single" $CXX -O3 $native -DNDEBUG "$@" "$folder/TreeNSearch/source/TreeNSearch.cpp" || broke TreeNSearch
            peer_objects="$peer_objects $dir/treensearch-$single.o -fopenmp -lpthread"
        fi
    fi
    if sources CompactNSearch SPH_BENCH_COMPACTNSEARCH https://github.com/InteractiveComputerGraphics/CompactNSearch; then
        set -- -std=c++11 -fopenmp -I"$folder/include"
        [ "$single" = 1 ] || set -- "$@" -DUSE_DOUBLE
        if adapter compactnsearch "$single" "$@"; then
            object "compactnsearch-$single" $CXX -O3 $native -DNDEBUG "$@" "$folder/src/CompactNSearch.cpp" || broke CompactNSearch
            peer_objects="$peer_objects $dir/compactnsearch-$single.o -fopenmp"
        fi
    fi
    if sources cornerstone SPH_BENCH_CORNERSTONE https://github.com/sekelle/cornerstone-octree; then
        adapter cornerstone "$single" -std=c++20 -I"$folder/include"
    fi
    [ -z "$peers" ] || peer_objects="$peer_objects -lstdc++"
}
# speed_program SINGLE: all forms of one precision
speed_program() {
    single=$1 forms='' more=''
    others "$single"
    set -- $CC $flags -DSPH_SINGLE="$single" $warn
    object "main-$single" "$@" -DBENCH_FORM=form_main -DSPH_CHECK=0 -DBENCH_SEARCH=1 -DBENCH_SWEEPS=OPERATORS $source &
    object "checked-$single" "$@" -DBENCH_FORM=form_checked -DBENCH_SWEEPS=APPLY $source
    forms="$forms F(checked)" more="$more $dir/checked-$single.o"
    if "$@" -dM -E $source 2> /dev/null | grep -q 'define __AVX2__ '; then
        object "portable-$single" "$@" -DBENCH_FORM=form_portable -DSPH_AVX512=0 -DSPH_AVX2=0 -DBENCH_SEARCH=1 $source
        forms="$forms F(portable)" more="$more $dir/portable-$single.o"
    fi
    if [ "$cores" -lt 2 ]; then
        skip_once "two threads" "there is one core"
    elif awk -v load="${load:-0}" 'BEGIN { exit load <= 1 }'; then
        skip_once "two threads" "no second core is free (load $load)"
    elif runs "#include <omp.h>\nint main(void) { omp_set_num_threads(2); return 0; }" '' $CC -fopenmp; then
        object "threads-$single" "$@" -fopenmp -DSPH_OPENMP=1 -DBENCH_FORM=form_threads -DSPH_CHECK=0 -DBENCH_SEARCH=1 -DBENCH_SWEEPS=2 $source
        forms="$forms F(threads)" more="$more $dir/threads-$single.o -fopenmp"
    else
        skip_once "two threads" "$why"
    fi
    wait
    program "speed-$single" "$peers" "$dir/main-$single.o $more $peer_objects" $CC $flags -DSPH_SINGLE="$single"
}
speed_tables() {
    awk -F, '
    # ---- the search: a table for each precision and number of particles
    $1 == "search" {
        cloud = $2 FS $3 FS $4 FS $5
        if (!(cloud in row)) { row[cloud] = ++rows; name[rows] = cloud; pairs[cloud] = $9; n[cloud] = $3 }
        code = $6 ($6 != "OpenMP" ? "" : $7 == 2 ? ", 2 threads" : ", 1 thread")
        if (!(code in column)) { column[code] = ++columns; codes[columns] = code; ours[columns] = 0 }
        if ($6 == "avx512" || $6 == "avx2" || $6 == "portable" || $6 == "OpenMP") ours[column[code]] = 1
        ns[cloud, code] = $8
        if ($9 != pairs[cloud]) differs[++differences] = code " finds " ($9 > pairs[cloud] ? $9 - pairs[cloud] " more" : pairs[cloud] - $9 " fewer") " of " pairs[cloud] " (" $4 ", " $5 ", " $2 ")"
        if ($9 - pairs[cloud] > 4 + pairs[cloud] / 100000 || pairs[cloud] - $9 > 4 + pairs[cloud] / 100000) wrong = 1
    }
    $1 == "limit" { limit[++limits] = $0; if ($4 ~ /W \+ F/) wf[$2] = $5; if ($4 ~ /GB/) copy[$2, $3] = $5 }
    # ---- the sweeps
    $1 == "sweep" {
        key = $2 FS $3 FS $6
        form = $7 FS $8 FS $5
        if (!(key in seen)) { seen[key] = ++sweeps; sweep[sweeps] = key }
        t[key, form] = $9; m[key] = $10 / $3; if (form == "main,1,sorted") bytes[key] = $12
    }
    function cell(a, b) { return a && b ? sprintf("%.2f", a / b) : "-" }
    END {
        print "## Search\n"
        print "Nanoseconds per particle for all lists. The last column is the first one over the fastest other code. Two threads: by"
        print "the clock, so that what else the machine does counts, too.\n"
        for (r = 1; r <= rows; r++) {
            split(name[r], c, FS)
            if (c[1] FS c[2] != before && (c[1] != p || c[3] == "lattice" || !p)) {
                printf "%s### %s, n = %s\n\n| cloud | order | neighbours |", p ? "\n" : "", c[1], c[2]
                for (k = 1; k <= columns; k++) printf " %s%s |", ours[k] ? "sph.h, " : "", codes[k]
                printf " ours / fastest other |\n|---|---|---|"
                for (k = 0; k <= columns; k++) printf "---|"
                print ""
            }
            before = c[1] FS c[2]; p = c[1]
            printf "| %s | %s | %.1f |", c[3], c[4], pairs[name[r]] / n[name[r]]
            best = 0
            for (k = 1; k <= columns; k++) {
                v = ns[name[r], codes[k]]
                printf " %s |", v ? sprintf("%.0f", v) : "-"
                if (!ours[k] && v && (!best || v < best)) best = v
            }
            printf " %s |\n", cell(ns[name[r], codes[1]], best)
        }
        print ""
        if (!differences) print "All codes find the same number of pairs in each cloud."
        for (k = 1; k <= differences; k++) print "* pairs: " differs[k]
        if (wrong) print "* pairs: THE DIFFERENCES ARE TOO MANY FOR ROUNDING"
        print "\n## Operators\n"
        print "On the lists of the lattice, sorted, without checks, one thread. The limit is the copy: the bytes that must be moved, over"
        print "its bytes per second, relative to the time that was measured. / (W + F): a pair, relative to one kernel value and"
        print "derivative from r^2 in cache. Then factors of time: random order, checks; and of speed: two threads."
        p = ""
        for (k = 1; k <= sweeps; k++) {
            split(sweep[k], c, FS)
            if (c[1] FS c[2] != p) {
                p = c[1] FS c[2]
                printf "\n### %s, n = %s: W + F %.2f ns, copy %.1f GB/s\n\n", c[1], c[2], wf[c[1]], copy[c[1], c[2]]
                print "| operator | ns/particle | ns/pair | / (W + F) | bytes/pair | % of the limit | random order | with checks | 2 threads |"
                print "|---|---|---|---|---|---|---|---|---|"
            }
            a = t[sweep[k], "main,1,sorted"]
            printf "| %s | %.0f | %.2f | %s | %.1f | %.0f | %s | %s | %s |\n", c[3], a, a / m[sweep[k]], cell(a / m[sweep[k]], wf[c[1]]), bytes[sweep[k]] / m[sweep[k]],
                100 * bytes[sweep[k]] / copy[c[1], c[2]] / a, cell(t[sweep[k], "main,1,random"], a), cell(t[sweep[k], "checked,1,sorted"], a), cell(t[sweep[k], "threads,1,sorted"], t[sweep[k], "threads,2,sorted"])
        }
        print "\n## Beside the sweep that moves the same data\n"
        print "Time, relative to that of a sweep that reads and writes about the same; sorted, one thread."
        several = split("with Molteni\047s diffusion=density rate;with Antuono\047s diffusion=density rate;with Antuono\047s diffusion, less density rate=fluid rates;gas rates=fluid rates;gas rates with its own h=fluid rates;" \
            "Espanol & Revenga\047s viscosity=Morris\047s viscosity;Riemann solver=fluid rates;tension by the stress=acceleration by pressure;" \
            "tension by the curvature=density rate;rows of wall particles=wall particles;linear fit=corrected gradient;" \
            "gradient with gamma=plain gradient;factor of DFSPH=plain gradient", beside, ";")
        p = ""
        for (k = 1; k <= sweeps; k++) {
            split(sweep[k], c, FS)
            if (c[1] FS c[2] == p) continue
            p = c[1] FS c[2]
            printf "\n### %s, n = %s\n\n| operator | beside | time |\n|---|---|---|\n", c[1], c[2]
            for (r = 1; r <= several; r++) {
                split(beside[r], two, "=")
                split(two[1], terms, ", less ")
                printf "| %s | %s | %s |\n", two[1], two[2], cell(t[p FS terms[1], "main,1,sorted"] - t[p FS terms[2], "main,1,sorted"], t[p FS two[2], "main,1,sorted"])
            }
        }
        exit wrong
    }' "$csv"
}
# Whole steps: the dam break of examples/papers, lists kept under a skin of 0.3 particle distances. CPU time of a
# fluid particle and step, everything included; the shortest of three.
dam() {
    if ! $CC $flags -std=c99 -o "$dir/dam" examples/papers/clustering_dam.c -lm > "$log" 2>&1; then
        broke "examples/papers/clustering_dam.c does not compile"
        return
    fi
    for round in 1 2 3; do
        "$dir/dam" -kernel wendland-c2-1d -remedy sequential -dref 0.01 -dt 1e-4 -tend 0.03 -out "$dir" -figures "$dir" -quiet > "$log" || failed=1
        cat "$dir/clustering_dam.csv"
    done | awk -F, '
    $1 == "item" { for (k = 1; k <= NF; k++) if ($k == "measured") m = k }
    $3 ~ /^CPU time of a particle/ && (!us || $m < us) { us = $m }
    $3 == "fluid particles" { n = $m }
    $3 ~ /neighbour list lasts/ { steps = $m }
    END {
        print "\n## A whole step\n"
        printf "The dam break in 2D with %d fluid particles: %.2f us per particle and step; a list lasts %.1f steps.\n", n, us, steps
    }'
}
# a program that fails where the processor lacks what the flags ask for
known='int main(void)
{
#ifdef __AVX2__
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 1;
#endif
    return 0;
}'
speed() {
    if [ -z "$flags" ]; then
        for flags in "-O3 -march=x86-64-v3 $simd" "-O3 -march=native $simd" "-O3 -march=native" -O3 -O2; do
            runs "$known" '' "$CC $flags" && break
        done
    fi
    runs "$known" '' "$CC $flags" || { echo "failed: $why"; exit 2; }
    : > "$csv"
    for single in 0 1; do
        if ! speed_program $single; then
            broke "tests/bench does not build"
            continue
        fi
        "$dir/speed-$single" -n "${sizes:-1e5}" -rounds "$rounds" -clouds "$clouds" >> "$csv" || failed=1
    done
    {
        heading "The search and the operators" "$CC"
        echo "* flags: \`$flags\`"
        echo "* the shortest of $rounds rounds; % spread of the rounds, in the middle: $(awk -F, '$1 == "search" { print 100 * $10 } $1 == "sweep" { print 100 * $11 }' "$csv" | sort -n | awk '{ v[NR] = $1 } END { printf "%.0f", v[int((NR + 1) / 2)] }')"
        echo
        speed_tables || failed=1
        dam
    } > "$table"
}

# ---------------------------------------------------------------- flags

# Each variant is a program; they run in turns.
variants() {
    $1 "gcc -O2" "$GCC" -O2
    $1 "gcc -O2 simd" "$GCC" -O2 $simd
    $1 "gcc -O3 simd -march=native" "$GCC" -O3 $simd -march=native
    $1 "gcc -O3 simd -march=x86-64-v3" "$GCC" -O3 $simd -march=x86-64-v3
    $1 "gcc -O3 simd -march=native -mprefer-vector-width=256" "$GCC" -O3 $simd -march=native -mprefer-vector-width=256
    $1 "gcc -O3 simd -march=native -mprefer-vector-width=256 no-gather" "$GCC" -O3 $simd -march=native -mprefer-vector-width=256 -mtune-ctrl=^use_gather_2parts,^use_gather_4parts,^use_gather
    $1 "clang -O2" "$CLANG" -O2
    $1 "clang -O2 -march=native" "$CLANG" -O2 -march=native
    $1 "clang -O2 -march=x86-64-v3" "$CLANG" -O2 -march=x86-64-v3
}
build_variant() {
    title=$1
    shift
    count=$((count + 1))
    rm -f "$dir/flags-$count-"?
    if ! runs "$empty" '' "$@"; then
        skip "$title" "$why"
        return
    fi
    forms=''
    for single in 0 1; do
        (
            object "flags-$count-$single-main" "$@" $warn -DSPH_SINGLE=$single -DBENCH_FORM=form_main -DSPH_CHECK=0 -DBENCH_SEARCH=1 -DBENCH_SWEEPS=ACCELERATION $source
            program "flags-$count-$single" '' "$dir/flags-$count-$single-main.o" "$@" -DSPH_SINGLE=$single || broke "$title"
        ) &
    done
    wait
    [ -x "$dir/flags-$count-0" ] && [ -x "$dir/flags-$count-1" ] || failed=1
}
run_variant() {
    count=$((count + 1))
    for single in 0 1; do
        [ -x "$dir/flags-$count-$single" ] || continue
        "$dir/flags-$count-$single" -n "${sizes:-64000}" -rounds 2 -clouds lattice | sed "s/^/$1,/" >> "$csv"
    done
}
# the first two lines of a table in Markdown, for awk
table_head='function head(first, column, columns,    k, rule) {
    printf "| %s |", first
    rule = "|---|"
    for (k = 1; k <= columns; k++) { printf " %s |", column[k]; rule = rule "---|" }
    print "\n" rule
}'
flags_table() {
    awk -F, "$table_head"'
    function least(row, what, precision, value) {
        if (!(row in known)) { known[row] = 1; name[++rows] = row }
        if (!((row, what, precision) in ns) || value < ns[row, what, precision]) ns[row, what, precision] = value
    }
    $2 == "limit" && $5 ~ /W \+ F/ { least($1, "W + F", $3, $6) }
    $2 == "sweep" && $6 == "sorted" { least($1, $7, $3, $10 * $4 / $11) }
    $2 == "search" && $6 == "sorted" { least($1, "search", $3, $9); n = $4 }
    END {
        columns = split("density,corrected gradient,fluid rates,SPMHD with cleaning,M-SPH rows,search", column, ",")
        head("compiler and flags", column, columns)
        for (r = 1; r <= rows; r++) {
            printf "| `%s` |", name[r]
            for (k = 1; k <= columns; k++) {
                form = column[k] == "search" ? "%.0f / %.0f" : "%.1f / %.1f"
                printf " " form " |", ns[name[r], column[k], "double"], ns[name[r], column[k], "float"]
            }
            print ""
        }
        printf "\nNanoseconds, double / float: of a pair for the operators, of a particle for the search. A lattice of %d\n", n
        print "particles in 3D, sorted, Wendland C2, one thread, `-DSPH_CHECK=0`. `simd` stands for `-fopenmp-simd"
        print "-DSPH_SIMD=1`, `no-gather` for `-mtune-ctrl=^use_gather_2parts,^use_gather_4parts,^use_gather`."
    }' "$csv"
}
measure_flags() {
    count=0
    variants build_variant
    : > "$csv"
    turn=0
    while [ $turn -lt "$rounds" ]; do
        count=0 turn=$((turn + 1))
        variants run_variant
    done
    {
        heading "What flags are worth" "$GCC" "$CLANG"
        echo "* one thread; the programs of all rows ran in turns, $rounds times; the shortest times"
        echo
        flags_table
    } > "$table"
}

# ---------------------------------------------------------------- compile

texts='nothing|int main(void) { return 0; }
unused|#include "sph.h"
lists|#include "sph.h"\nsph_index f(sph_points x, sph_scalars r, void *m, size_t s, sph_neighbors *n) { return sph_search(3, x, r, SPH_GATHER, m, s, n); }
lists and density|#include "sph.h"\nsph_index f(sph_points x, sph_scalars r, void *m, size_t s, sph_neighbors *n) { return sph_search(3, x, r, SPH_GATHER, m, s, n); }\nsph_index g(sph_cloud c, sph_scalars m, sph_scalar_out o) { return sph_density_summation(SPH_WENDLAND_C2, 3, c, m, o); }
SPMHD|#include "sph.h"\nsph_index f(sph_cloud c, sph_mhd s, sph_mhd_out o) { return sph_mhd_rates(SPH_WENDLAND_C2, 3, c, s, o); }'
user_seconds() { # COMMAND ...: of the children of a shell
    ("$@" > "$log" 2>&1 || exit 1; times) | sed -n '2s/^\([0-9]*\)m\([0-9.]*\)s.*/\1 \2/p' | awk '{ print 60 * $1 + $2; some = 1 } END { exit !some }'
}
measure_compile() {
    : > "$csv"
    turn=0
    while [ $turn -lt "$rounds" ]; do
        turn=$((turn + 1))
        for compiler in "$GCC" "$CLANG"; do
            if ! runs "$empty" - $compiler; then
                [ $turn -gt 1 ] || skip "$compiler" "$why"
                continue
            fi
            for level in -O0 -O2 -O3; do
                printf '%s\n' "$texts" | while IFS='|' read -r what text; do
                    printf '%b\n' "$text" > "$dir/compile.c"
                    if seconds=$(user_seconds $compiler -std=c99 $level -I. -c -o "$dir/compile.o" "$dir/compile.c"); then
                        echo "$compiler $level,$what,$seconds,$(size "$dir/compile.o" | awk 'NR == 2 { print $1 }')" >> "$csv"
                    else
                        broke "$compiler $level, $what"
                    fi
                done
            done
        done
    done
    {
        heading "What compilation costs" "$GCC" "$CLANG"
        echo "Seconds of CPU and bytes of machine code (text) of a file with one call of each in 3D; the shortest of $rounds."
        echo "\`nothing\` is a file without the headers. In \`unused\` they are included, and nothing is called."
        echo
        awk -F, "$table_head"'
        !($1 in row) { row[$1] = ++rows; name[rows] = $1 }
        !($2 in column) { column[$2] = ++columns; what[columns] = $2 }
        !(($1, $2) in s) || $3 < s[$1, $2] { s[$1, $2] = $3 }
        { b[$1, $2] = $4 }
        END {
            head("", what, columns)
            for (r = 1; r <= rows; r++) {
                printf "| `%s` |", name[r]
                for (k = 1; k <= columns; k++) printf " %.2f s, %d B |", s[name[r], what[k]], b[name[r], what[k]]
                print ""
            }
        }' "$csv"
    } > "$table"
}

# ---------------------------------------------------------------- all

case $mode in
speed) speed ;;
flags) measure_flags ;;
compile) measure_compile ;;
esac
cat "$table"
echo
echo "figures: $csv; tables: $table"
if [ -n "$keep" ] && [ $failed -eq 0 ]; then
    mkdir -p tests/bench/results
    cp "$table" "tests/bench/results/$mode.md"
    echo "kept in tests/bench/results/$mode.md"
    if [ $mode = flags ]; then
        # README.md has the table between two comments
        flags_table > "$dir/quoted"
        awk -v quoted="$dir/quoted" '
        /^<!-- end of make bench-flags -->$/ { inside = 0 }
        !inside
        /^<!-- make bench-flags -->$/ { inside = 1; while ((getline line < quoted) > 0) print line }' README.md > "$dir/README.md" && cp "$dir/README.md" README.md
    fi
fi
[ $failed -eq 0 ]
