#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs test programs and scripts, each of which prints 'name: N passed, N failed', and prints the sum as its last line. One that ends with an error without
# having counted a failure (a crash, a missing program) counts as one, and so does one that checked nothing without a reason, and a reason to skip that is not so (skips.sh).
#     tests/run.sh PROGRAM_OR_SCRIPT ...          from the root of the repository; JOBS=2: two at a time
BUILD=${BUILD:-build}
export BUILD
logs=$BUILD/scratch/run
rm -rf "$logs"
mkdir -p "$logs" || exit 2
sh examples/common/progress.sh tests "$logs/*.status" $(echo "$@" | tr / _) &
watcher=$!
# one that is long comes first, so that it does not run alone at the end; printed in the order of the command line
{
    for t in "$@"; do case $t in *.sh) echo "$t" ;; esac done
    for t in "$@"; do case $t in *.sh) ;; *) echo "$t" ;; esac done
} | LOGS=$logs xargs -P "${JOBS:-1}" -n 1 sh -c '
    log=$LOGS/$(echo "$1" | tr / _)
    case $1 in *.sh) sh "$1" ;; *) "$1" ;; esac > "$log" 2>&1
    echo $? > "$log.status"' run
kill $watcher 2> /dev/null
wait $watcher
passed=0 failed=0
for t in "$@"; do
    log=$logs/$(echo "$t" | tr / _)
    output=$(cat "$log")
    status=$(cat "$log.status" || echo 127)
    [ -n "$output" ] && printf '%s\n' "$output"
    counts=$(printf '%s\n' "$output" | sed -n 's/^.*: \([0-9][0-9]*\) passed, \([0-9][0-9]*\) failed$/\1 \2/p' | awk '{ p += $1; f += $2 } END { print p + 0, f + 0 }')
    passed=$((passed + ${counts% *}))
    failed=$((failed + ${counts#* }))
    if ! untrue=$(printf '%s\n' "$output" | sh tests/skips.sh); then
        printf '%s: skipped what is installed: %s\n' "$t" "$untrue"
        failed=$((failed + 1))
    fi
    if [ $status -ne 0 ] && [ "${counts#* }" -eq 0 ]; then
        echo "$t: ended with status $status"
        failed=$((failed + 1))
    elif [ "$counts" = "0 0" ]; then
        case $output in
        *"skipped: "*": "*) ;;
        *)
            echo "$t: checked nothing"
            failed=$((failed + 1))
            ;;
        esac
    fi
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
