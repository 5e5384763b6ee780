#!/bin/sh
# SPDX-License-Identifier: MIT
# Reads what tests print, and prints each of its lines 'skipped: WHAT: WHY' whose WHY is not so here. Ends with 1 if there is one.
#     tests/skips.sh < LOG
#         WHY says that a tool, or a package '(Debian: PACKAGE ...)', is not installed, but it is
#     tests/skips.sh full < LOG
#         the same, and every WHY that is neither that nor something that the processor lacks: where all is installed, and works, there is no other reason to skip
full=${1:-}
untrue() { # WHY
    why=$1
    case $why in *"(Debian: "*)
        packages=${why##*"(Debian: "}
        installed='' # all of them; where there is no dpkg, nobody knows
        for package in ${packages%%")"*}; do
            dpkg -s "$package" 2> /dev/null | grep -q '^Status: .* installed$' || installed=no
        done
        [ -z "$installed" ]
        return
        ;;
    esac
    tool=$(printf '%s\n' "$why" | sed -n 's/^\(.*[ :;]\)*\([^ :;]*\) is not installed.*/\2/p')
    if [ "$tool" ]; then
        command -v "$tool" > /dev/null 2>&1
        return
    fi
    case $why in *"not on this machine" | *"not on this processor") return 1 ;; esac
    [ "$full" ]
}
status=0
while IFS= read -r line; do
    case $line in skipped:*:*) ;; *) continue ;; esac
    untrue "${line#skipped: *: }" || continue
    printf '%s\n' "$line"
    status=1
done
exit $status
