#!/bin/sh
# SPDX-License-Identifier: MIT
# One line for commands that take long: what is done, for how long it has run, and how long it will yet take,
# from the times of the last run, which are kept in $BUILD/seconds. On terminals only, and not where CI is set.
#     . examples/common/progress.sh
#     progress_begin NAME [TOTAL]     NAME: of the command; TOTAL: its parts, where that is known
#     progress DONE [WHAT]            so many parts are done; what is next
#     progress_hide                   before anything else is printed
#     progress_end                    keeps the times
# As a program it watches from beside, until it is killed or what has started it is gone: a part is done when the
# file is there that FILE with the part for its * names.
#     sh examples/common/progress.sh NAME FILE PART ... &
progress_began=
progress_begin() {
    [ -t 2 ] && [ -z "${CI:-}" ] || return 0
    progress_name=$1 progress_total=${2:-} progress_kept=0 progress_reached=0 progress_began=$(date +%s)
    progress_times=${BUILD:-build}/seconds/$1
    mkdir -p "${BUILD:-build}/seconds" && : > "$progress_times.part" || progress_began=
}
progress() {
    [ "$progress_began" ] || return 0
    progress_gone=$(($(date +%s) - progress_began))
    while [ $progress_kept -lt "$1" ]; do
        echo $progress_gone >> "$progress_times.part"
        progress_kept=$((progress_kept + 1)) progress_reached=$progress_gone
    done
    # line n of the last run's times: when n parts were done
    progress_left=$(cat "$progress_times" 2> /dev/null | awk -v parts="$1" -v gone=$progress_gone -v reached=$progress_reached -v total="$progress_total" '
        NR == parts { then = $1 }
        { end = $1 }
        END {
            if (NR > parts) left = (end - then) * (then >= 10 ? reached / then : 1) - (gone - reached)
            else if (parts > 0 && total > parts) left = reached * (total - parts) / parts - (gone - reached)
            if (left > 0) printf ", some %d s left", left
        }')
    printf '\r%-79.79s\r' "$progress_name: $1${progress_total:+ of $progress_total} done, $progress_gone s gone$progress_left${2:+: $2}" >&2
}
progress_hide() { [ -z "$progress_began" ] || printf '\r%79s\r' '' >&2; }
progress_end() {
    [ "$progress_began" ] || return 0
    progress_hide
    mv "$progress_times.part" "$progress_times"
}

case $0 in *progress.sh)
    [ $# -gt 2 ] || { echo "usage: sh $0 NAME FILE PART ..." >&2; exit 2; }
    name=$1 file=$2
    shift 2
    progress_begin "$name" $#
    [ "$progress_began" ] || exit 0
    trap 'progress $#; progress_end; exit 0' TERM
    while kill -0 "$PPID" 2> /dev/null; do
        parts=0
        for part in "$@"; do
            [ ! -e "${file%%\**}$part${file#*\*}" ] || parts=$((parts + 1))
        done
        progress $parts
        sleep 1
    done
    ;;
esac
