#!/bin/sh
# SPDX-License-Identifier: MIT
# restarts.sh - a run that is stopped and goes on gives what a run in one piece gives, bit for bit.
. tests/check.sh
bin=$BUILD/examples

# pieces NAME COMMAND ...: in one piece, and stopped after a second; then the figures' data are compared.
# On a machine that is faster than that there is nothing to go on from.
pieces() {
    name=$1
    shift
    mkdir -p "$scratch/$name/whole" "$scratch/$name/pieces"
    check "$name in one piece" answers 0 "0 differs" "$@" -out "$scratch/$name/whole" -figures "$scratch/$name/whole"
    "$@" -continue -out "$scratch/$name/pieces" -figures "$scratch/$name/pieces" > "$scratch/$name/log" 2>&1 &
    pid=$!
    sleep 1
    kill -INT $pid 2> /dev/null
    wait $pid
    status=$?
    if [ $status -eq 130 ]; then
        check "$name leaves a restart" test -n "$(ls "$scratch/$name/pieces"/*.restart)"
        check "$name says how to go on" grep -q -e "-continue goes on" "$scratch/$name/log"
        check "$name goes on" answers 0 "0 differs" "$@" -continue -out "$scratch/$name/pieces" -figures "$scratch/$name/pieces"
        for file in "$scratch/$name/whole"/*_fig*.csv; do
            check "$name: ${file##*/}" cmp "$file" "$scratch/$name/pieces/${file##*/}"
        done
        for restart in "$scratch/$name/pieces"/*.restart; do
            printf "not what it was" | dd of="$restart" bs=1 seek=2000 conv=notrunc 2> /dev/null
        done
        check "$name refuses a damaged restart" answers 2 "damaged; remove it, or run without -continue" "$@" -continue -out "$scratch/$name/pieces" -figures "$scratch/$name/pieces"
    else
        check "$name ended, or was interrupted" test $status -eq 0
    fi
}
if [ -x "$bin/cleaning_orszag_tang" ] && [ -x "$bin/clustering_shaft" ]; then
    pieces vortex "$bin/cleaning_orszag_tang" -side 40 -case cleaning -end 0.5 -threads 1
    pieces shaft "$bin/clustering_shaft" -kernel wendland-c4 -remedy weighted -tend 0.02 -threads 1 -quiet
else skip "restarts" "their drivers were not built"; fi
finish restarts
