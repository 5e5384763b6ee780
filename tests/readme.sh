#!/bin/sh
# SPDX-License-Identifier: MIT
# The complete programs of README.md, examples/USING.md and examples/hosts/BEYOND.md compile without a warning and
# print what the pages say; every function and file that the pages name exists.
. tests/check.sh
pages="README.md examples/README.md examples/USING.md examples/OPERATORS.md examples/papers/README.md examples/fluids/README.md examples/solids/README.md examples/gas/README.md examples/atlas/README.md examples/hosts/BEYOND.md tests/README.md tests/PLATFORMS.md CONTRIBUTING.md tests/VERIFICATION.md"
program() { # PAGE TEXT: the page's only program, and what it must print
    awk '/^```c$/ { on = 1; next } /^```$/ { on = 0 } on' "$1" > "$scratch/program.c"
    check "the program of $1 compiles" $CC -std=c99 -Wall -Wextra -Wpedantic -Werror -O2 -I. -o "$scratch/program" "$scratch/program.c" -lm
    check "the output of the program of $1" answers 0 "$2" "$scratch/program"
}
program README.md "^f'' = 2.0000000000 at the end of the line, 2.0000000000 in the middle$"
program examples/USING.md "^gradient in the corner: 2.000000 -*0.000000 -*0.000000$"
program examples/hosts/BEYOND.md "^densities agree, momentum conserved$"
known=$(grep -o -h -w 'sph_[a-z0-9_]*' sph_kernels.h sph_ops.h sph.h | sort -u)
for page in $pages; do
    named=$(grep -o 'sph_[a-z0-9_]*' "$page" | grep -v -x -F -e "$known" -e sph_kernels -e sph_ops | sort -u)
    check "$page names these, which do not exist: $named" test -z "$named"
    for file in $(grep -o '`[a-z_/]*\.[a-z]*`' "$page" | tr -d '`' | grep / | sort -u); do
        check "$page names $file" test -e "$file"
    done
done
finish readme
