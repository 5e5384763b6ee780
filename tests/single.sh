#!/bin/sh
# SPDX-License-Identifier: MIT
# The single-file examples: each is at most 200 lines, builds from the root without a warning with the very line of its opening comment, passes its self-check (-t), draws something,
# writes a table (-o), finds nothing wrong with its cloud (EXAMINE 1), has help, and answers wrong use with a clear error and exit status 2. Where the disk is full, or a limit kills it within its first
# kilobytes, the old table stays. The gallery names each, with its picture and its line.
. tests/check.sh

build() { # the cc line with this compiler, warnings as errors, into the scratch directory
    case $1 in "cc -O2 -I. -o $name examples/$name.c -lm") ;; *) echo "no such line: '$1'" && return 1 ;; esac
    $CC -Wall -Wextra -Werror $(echo "${1#cc }" | sed "s|-o $name|-o $scratch/$name|")
}

changed() { # name, what sed changes: builds that into the scratch directory, with the doctor; not forced inline, which takes longer
    sed -e 's/^#define EXAMINE 0/#define EXAMINE 1/' -e "$2" "examples/$1.c" > "$scratch/$1-changed.c"
    $CC -std=c99 -O2 "$freely" -I. -o "$scratch/$1-changed" "$scratch/$1-changed.c" -lm
}
quiet() { "$@" 2>&1 > /dev/null | { ! grep .; }; }
limited() { (ulimit -f 4 && exec "$@"); }

for source in examples/*.c; do
    name=$(basename "$source" .c)
    line=$(sed -n 's/^ \*  *\(cc .*\)$/\1/p' "$source" | head -n 1)
    check "$name: 200 lines" test "$(wc -l < "$source")" -le 200
    check "$name: '$line'" build "$line"
    check "$name: self-check" answers 0 "^ok$" "$scratch/$name" -t
    if grep -q '^#define EXAMINE 0' "$source"; then # not where there are no particles
        check "$name, examined: compiles" changed "$name" ''
        check "$name, examined: self-check" answers 0 "^ok$" "$scratch/$name-changed" -t
        check "$name, examined: no finding" quiet "$scratch/$name-changed"
    elif grep -q sph_cloud "$source"; then
        check "$name: EXAMINE" false
    fi
    check "$name: help" answers 0 "^$name .*-t" "$scratch/$name" -h
    check "$name: unknown option" answers 2 "$name: unknown option.*-nonsense" "$scratch/$name" -nonsense
    check "$name: missing value" answers 2 "$name: .*-o" "$scratch/$name" -o
    check "$name: a file that cannot be written" answers 2 "no/such/folder" "$scratch/$name" -o no/such/folder/x.csv
    check "$name: a table" "$scratch/$name" -o "$scratch/$name.csv"
    check "$name: a table with numbers" test "$(wc -l < "$scratch/$name.csv")" -gt 100
    check "$name: a table without failed numbers" test "$(grep -c -i -e nan -e inf "$scratch/$name.csv")" -eq 0
    check "$name: something to see" answers 0 "[^ ]" "$scratch/$name"
    check "$name: lines of 80 characters" test "$(awk '{ gsub(/\033\[[0-9]*[A-Z]/, ""); if (length($0) > most) most = length($0) } END { print most + 0 }' "$scratch/output")" -le 80
    check "$name: the gallery has its line" grep -q -x -F "    $line" examples/README.md
    check "$name: the gallery has its picture" grep -q -F "(gallery/$name.png)" examples/README.md
    check "$name: a picture of at most 40 KB" test "$(wc -c < "examples/gallery/$name.png")" -le 40960
done

# all of them save alike (files.sh)
for name in density_cloud hello_kernel host_lists; do
    table=$scratch/$name-old.csv
    echo old > "$table"
    limited "$scratch/$name" -o "$table" > "$scratch/output" 2>&1
    check "$name: killed" test $? -gt 128 -a -s "$table.part" -a "$(cat "$table")" = old
    rm -f "$table.part"
    [ -c /dev/full ] || continue
    ln -s /dev/full "$table.part"
    check "$name: full disk" answers 2 "No space" "$scratch/$name" -o "$table"
    check "$name: full disk: the old table" test "$(cat "$table")" = old -a ! -e "$table.part"
    check "$name: full device" answers 2 "No space" "$scratch/$name" -o /dev/full
    check "$name: full device: it stays" test -c /dev/full
done

check "a list that is too short: compiles" changed dam_break 's/sph_kernel_support_ratio(KERNEL) \* h/h/'
check "a list that is too short is found" answers 0 "^particle [0-9]*, neighbour [0-9]*, ratio .* The list ends at" "$scratch/dam_break-changed"
check "a position that is none: compiles" changed dam_break 's/^    fill(20);/    fill(20);\n    x[17] = NAN;/'
check "a position that is none is refused in words" answers 1 "^x: a position is not finite or too large, .*first at particle 17$" "$scratch/dam_break-changed"

# no heap and no stdio where there is no host: what embedded_loop asks of the system is arithmetic
if needs "embedded_loop, freestanding" nm; then
    check "embedded_loop, freestanding" $CC -std=c99 -ffreestanding -O2 -I. -c -o "$scratch/embedded_loop.o" examples/embedded_loop.c
    check "embedded_loop needs nothing but arithmetic" test -z "$(nm -u "$scratch/embedded_loop.o" | grep -v -e ' w ' | awk '{ print $NF }' | grep -v -x -e '_*\(sqrtf\|fabsf\|floorf\|fmaxf\|copysignf\|powf\|memset\|memcpy\)')"
fi
finish single
