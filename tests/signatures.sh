#!/bin/sh
# SPDX-License-Identifier: MIT
# What a call of the headers' public functions looks like: prints the most arguments, the median of the sweeps (those
# that take a cloud) and the longest run of arguments of one type, which a caller could swap unnoticed. Fails above the
# limits. From the root of the repository.
. tests/check.sh
most=7 median=5 run=3

# name, number of arguments, longest run, 1 if it takes a cloud
signatures() {
    sh tests/prototypes.sh | awk -F '|' '{
            n = $3 ~ /^ *(void)? *$/ ? 0 : split($3, a, ","); same = longest = cloud = 0; last = ""
            for (i = 1; i <= n; i++) {
                type = a[i]; sub(/[a-zA-Z0-9_]+ *$/, "", type); gsub(/SPH_GLOBAL|SPH_RESTRICT|const| /, "", type)
                if (type == "sph_cloud") cloud = 1
                if (type == last) same++; else same = 1
                if (same > longest) longest = same
                last = type
            }
            print $2, n, longest, cloud
        }'
}
signatures > "$scratch/signatures"
# shellcheck disable=SC2317
within() { awk -v most=$most -v run=$run '$2 > most || $3 > run { print; bad = 1 } END { exit bad || NR < 150 }' "$scratch/signatures"; }
check "no function has more than $most arguments, or more than $run of one type in a row" within
awk '$4 { print $2 }' "$scratch/signatures" | sort -n > "$scratch/sweeps"
middle=$(sed -n "$((($(wc -l < "$scratch/sweeps") + 1) / 2))p" "$scratch/sweeps")
check "the median of the sweeps is at most $median" test "$middle" -le $median
awk -v median="$middle" '{ if ($2 > most) most = $2; if ($3 > run) run = $3 }
    END { print NR " public functions; most arguments " most ", median of the sweeps " median ", longest run of one type " run }' \
    "$scratch/signatures"
finish signatures
