#!/bin/sh
# SPDX-License-Identifier: MIT
# A guest in other people's code: no macro and no symbol but sph_, SPH_, sphi_, SPHI_; headers in any order and twice; no headers of two releases together; and what an inclusion costs.
. tests/check.sh

# Bytes of code that an object may grow by, for an inclusion alone and for one corrected gradient in three dimensions with a constant kernel. Measured with gcc 12 and clang 14 on
# x86-64: 0; 31000 and 34000 at -O0, 3400 and 7900 at -O2; twice that is allowed.
budget_alone=0
budget_O0=68000
budget_O2=16000

macros() { $1 -std=c99 -I. -dM -E "$2" | sed 's/^#define \([A-Za-z0-9_]*\).*/\1/' | sort -u; }
# as it is included
printf '#include <math.h>\n#include <stddef.h>\n#include <stdint.h>\n' > "$scratch/without.c"
cat > "$scratch/use.c" << 'END'
#include "sph.h"
sph_index use(sph_points x, sph_list list, sph_real h, sph_scalars V, sph_scalars f, sph_real *gx, sph_real *gy, sph_real *gz);
sph_index use(sph_points x, sph_list list, sph_real h, sph_scalars V, sph_scalars f, sph_real *gx, sph_real *gy, sph_real *gz)
{
    const sph_cloud all = sph_cloud_of(x, list, sph_scalars_same(&h), V);
    return sph_gradient_cspm(SPH_WENDLAND_C2, 3, all, f, (sph_derivatives_out){.gx = gx, .gy = gy, .gz = gz});
}
END
size_of() { size "$1" | awk 'NR == 2 { print $1 + $2 + $3 }'; }
seconds() { # of processor time
    { LC_ALL=C bash -c 'TIMEFORMAT="%U %S"; time "$@" > /dev/null 2>&1' time "$@"; } 2>&1 | awk '{ printf "%.2f", $1 + $2 }'
}

echo "what an inclusion costs:          bytes, alone   with a 3D gradient   seconds, alone   with a 3D gradient"
for cc in gcc clang; do
    needs "names and sizes by $cc" nm size || continue
    usable "names and sizes by $cc" "$empty" '' "$cc -std=c99" || continue
    macros $cc "$scratch/without.c" > "$scratch/without"
    for header in sph_kernels.h sph_ops.h sph.h; do
        printf '#include "%s"\n' "$header" > "$scratch/alone.c"
        macros $cc "$scratch/alone.c" | comm -13 "$scratch/without" - | grep -v -e '^SPH_' -e '^SPHI_' > "$scratch/foreign"
        check "$cc, $header: no macro without the prefix: $(head -n 3 "$scratch/foreign" | tr '\n' ' ')" test ! -s "$scratch/foreign"
        check "$cc, $header" $cc -std=c99 -O0 -I. -c "$scratch/alone.c" -o "$scratch/alone.o"
        nm "$scratch/alone.o" > "$scratch/symbols"
        check "$cc, $header: no symbol: $(head -n 3 "$scratch/symbols")" test ! -s "$scratch/symbols"
        # what C sees beside the macros: types, constants, functions, in a listing of the header's own lines
        $cc -std=c99 -I. -E "$scratch/alone.c" | awk '/^# [0-9]+ "/ { own = $3 ~ /sph[a-z_]*\.h"$/; next } own' |
            sed -n -e 's/^} *\([A-Za-z_0-9]*\);.*/\1/p' -e 's/^typedef [^(){}]*[ *]\([A-Za-z_0-9]*\);.*/\1/p' \
                -e 's/^static [a-z ]*__attribute__(([a-z_, ]*)) [^(]*[ *]\([A-Za-z_0-9]*\)(.*/\1/p' -e 's/^ *\(SPH[A-Z_0-9]*\) *=.*/\1/p' | sort -u > "$scratch/declared"
        check "$cc, $header: the listing is one" test "$(wc -l < "$scratch/declared")" -gt 20
        grep -v -e '^$' -e '^sph_' -e '^sphi_' -e '^SPH_' -e '^SPHI_' "$scratch/declared" > "$scratch/foreign"
        check "$cc, $header: no name without the prefix: $(head -n 3 "$scratch/foreign" | tr '\n' ' ')" test ! -s "$scratch/foreign"
    done
    for level in -O0 -O2; do
        $cc -std=c99 $level -I. -c "$scratch/alone.c" -o "$scratch/alone.o"
        check "$cc $level" $cc -std=c99 $level -I. -c "$scratch/use.c" -o "$scratch/use.o"
        alone=$(size_of "$scratch/alone.o") use=$(size_of "$scratch/use.o")
        nm -g --defined-only "$scratch/use.o" | awk '{ print $3 }' > "$scratch/symbols"
        check "$cc $level: exports nothing but the host's function" test "$(cat "$scratch/symbols")" = use
        if [ $level = -O0 ]; then budget=$budget_O0; else budget=$budget_O2; fi
        check "$cc $level: an inclusion alone costs $alone bytes, $budget_alone are allowed" test "$alone" -le $budget_alone
        check "$cc $level: a gradient costs $use bytes, $budget are allowed" test "$use" -le $budget
        printf '    sph.h, %-24s %14s %20s %16s %20s\n' "$cc $level" "$alone" "$use" "$(seconds $cc -std=c99 $level -I. -c "$scratch/alone.c" -o "$scratch/alone.o")" \
            "$(seconds $cc -std=c99 $level -I. -c "$scratch/use.c" -o "$scratch/use.o")"
    done
done

# ---------------------------------------------------------------- a host's own short macros

# hosts define such names before they include anything: #define N 41
{
    cat "$scratch/without.c"
    for letter in A B C D E F G H I J K L M N O P Q R S T U V W X Y Z; do echo "#define $letter 41"; done
    echo '#include "sph.h"'
} > "$scratch/capitals.c"
for cc in "gcc -std=c99" "clang -std=c99" "g++ -x c++ -std=c++11" "clang++ -x c++ -std=c++11"; do
    usable "every capital letter a macro, $cc" "$empty" '' "$cc" || continue
    for single in 0 1; do
        # shellcheck disable=SC2086
        check "every capital letter a macro, $cc, SPH_SINGLE=$single" $cc -DSPH_SINGLE=$single -I. -fsyntax-only \
            "$scratch/capitals.c"
    done
done

# ---------------------------------------------------------------- order, and releases

for a in sph_kernels.h sph_ops.h sph.h; do
    for b in sph_kernels.h sph_ops.h sph.h; do
        printf '#include "%s"\n#include "%s"\n#include "%s"\n#include <math.h>\nint main(void) { return 0; }\n' $a $b $a > "$scratch/order.c"
        check "$a, $b, $a, in this order" $CC -std=c99 -Wall -Wextra -Wpedantic -Werror -I. -fsyntax-only "$scratch/order.c"
    done
done

version=$(sed -n 's/^#define SPH_VERSION \([0-9]*\).*/\1/p' sph_kernels.h)
part() { sed -n "s/^#define SPH_VERSION_$1 \([0-9]*\).*/\1/p" sph_kernels.h; }
check "SPH_VERSION is 10000 major + 100 minor + patch" test "$version" = $((10000 * $(part MAJOR) + 100 * $(part MINOR) + $(part PATCH)))
check "CHANGES tells of this version" grep -q "^## $(part MAJOR)\.$(part MINOR)\.$(part PATCH)\>" CHANGELOG.md
refuses() { # HEADER WHOSE RELEASE DIFFERS, HEADER THAT HAS TO REFUSE
    rm -rf "$scratch/mixed" && mkdir "$scratch/mixed" && cp sph.h sph_ops.h sph_kernels.h "$scratch/mixed"
    sed -i "s/SPH_VERSION != $version/SPH_VERSION != $((version + 1))/; s/^#define SPH_VERSION $version/#define SPH_VERSION $((version + 1))/" "$scratch/mixed/$1"
    printf '#include "%s"\n' "$2" > "$scratch/mixed.c"
    ! $CC -std=c99 "-I$scratch/mixed" -fsyntax-only "$scratch/mixed.c" > "$scratch/refused" 2>&1 && grep -q 'different releases' "$scratch/refused"
}
check "sph_ops.h refuses a later sph_kernels.h" refuses sph_kernels.h sph_ops.h
check "a later sph_ops.h refuses sph_kernels.h" refuses sph_ops.h sph_ops.h
check "a later sph.h refuses the others" refuses sph.h sph.h
finish names
