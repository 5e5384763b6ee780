#!/bin/sh
# SPDX-License-Identifier: MIT
# Float against double, on the same numbers: no output of an operator may differ by more than 20 float roundings of its largest value, times what the operator is allowed in test_invariance.c.
. tests/check.sh
values() { "$BUILD/tests/invariance$1" -values > "$scratch/values$1"; }
if [ -x "$BUILD/tests/invariance-float" ]; then
    check "double" values ""
    check "float" values -float
    check "as many values" test "$(wc -l < "$scratch/values")" -eq "$(wc -l < "$scratch/values-float")"
    paste -d ' ' "$scratch/values" "$scratch/values-float" | awk '
        $1 != $4 { print "different outputs:", $1, $4; exit 1 }
        { d = $3 - $6; if (d < 0) d = -d; s = $3 < 0 ? -$3 : $3; if (d > worst[$1]) worst[$1] = d; if (s > size[$1]) size[$1] = s; hard[$1] = $2 }
        END { for (o in size) print o, worst[o] / size[o] / 1.19e-7, 20 * hard[o] }' | sort > "$scratch/worst"
    while read -r output roundings allowed; do check "$output: $roundings float roundings, allowed $allowed" awk "BEGIN { exit !($roundings <= $allowed) }"; done < "$scratch/worst"
else
    skip "float against double" "the tests were not built in float"
fi
finish precision
