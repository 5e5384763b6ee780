#!/bin/sh
# SPDX-License-Identifier: MIT
# The drivers as programs: help, wrong use (a clear error and exit status 2), and a short run whose table has its columns and its verdicts.
BUILD=${BUILD:-build}
bin=$BUILD/examples
dir=$BUILD/tests/examples
mkdir -p "$dir"
passed=0 failed=0

expect() { # status, text that must be printed, command ...
    want=$1 text=$2
    shift 2
    "$@" > "$dir/log" 2>&1
    status=$?
    if [ $status -eq "$want" ] && grep -q -e "$text" "$dir/log"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "examples: status $status (expected $want) or without '$text': $*"
    fi
}
check() { # what, condition's status
    if [ "$2" -eq 0 ]; then passed=$((passed + 1)); else
        failed=$((failed + 1))
        echo "examples: failed: $1"
    fi
}

for d in icspm_uniform icspm_random icspm_dimensions; do
    expect 0 "-out" "$bin/$d" -h
    expect 2 "-nonsense" "$bin/$d" -nonsense
    expect 2 "-out" "$bin/$d" -out
    expect 2 "no/such/folder" "$bin/$d" -out no/such/folder
    expect 2 "no/such/folder" "$bin/$d" -out "$dir" -figures no/such/folder
done
expect 2 "-seed" "$bin/icspm_random" -seed x
expect 2 "-seed" "$bin/icspm_random" -seed -1
expect 2 "-small" "$bin/icspm_random" -small 3

expect 0 "0 differs" "$bin/icspm_uniform" -out "$dir" -figures "$dir"
head -n 1 "$dir/icspm_uniform.csv" | grep -q '^item,setting,quantity,published,measured,criterion,verdict$'
check "columns of the result table" $?
[ "$(grep -c '^Table [123],.*,match$' "$dir/icspm_uniform.csv")" -ge 105 ]
check "all of tables 1, 2, 3 match" $?
[ ! -e "$dir/icspm_uniform.csv.part" ]
check "no partial table is left" $?
[ "$(wc -l < "$dir/icspm_fig2.csv")" -eq 42 ]
check "figure 2 has 41 particles" $?

expect 0 "icspm_uniform" "$bin/scoreboard" "$dir/icspm_uniform.csv"
sed 's/,match$/,differs/' "$dir/icspm_uniform.csv" > "$dir/wrong.csv"
expect 1 "differ" "$bin/scoreboard" "$dir/wrong.csv"
expect 2 "missing.csv" "$bin/scoreboard" "$dir/missing.csv"

echo "examples: $passed passed, $failed failed"
[ $failed -eq 0 ]
