# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by the test scripts: counts checks.
#     check WHAT COMMAND ...      passes if the command succeeds; its output is shown if it fails
#     check WHAT answers STATUS TEXT COMMAND ...      passes if the command ends with that status (error: with any that is not 0, by itself) and prints that text
#     skip WHAT WHY               says aloud what is not tested
#     installed TOOL ...          succeeds if all of them are
#     needs WHAT TOOL ...         the same, and skips WHAT if not
#     compiles TEXT COMPILER FLAGS ...      succeeds if that makes a program of the text ($empty: of an empty one); a COMPILER may be of several words
#     finish NAME                 prints 'NAME: N passed, N failed' and ends with 1 if a check failed
BUILD=${BUILD:-build}
CC=${CC:-cc}
scratch=$BUILD/scratch/$(basename "$0" .sh)
rm -rf "$scratch"
mkdir -p "$scratch" || exit 2
passed=0
failed=0
check() {
    what=$1
    shift
    if "$@" > "$scratch/log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "failed: $what: $*"
        head -n 5 "$scratch/log"
    fi
}
answers() { # status, text that must be printed, command ...
    want=$1 text=$2
    shift 2
    "$@" > "$scratch/output" 2>&1
    status=$?
    if [ "$want" = error ]; then [ $status -ne 0 ] && [ $status -lt 124 ]; else [ $status -eq "$want" ]; fi && grep -q -e "$text" "$scratch/output" && return
    echo "status $status (expected $want), or without '$text':"
    head -n 3 "$scratch/output"
    return 1
}
skip() { echo "skipped: $1: $2"; }
installed() {
    for tool in "$@"; do command -v "$tool" > /dev/null 2>&1 || return 1; done
}
needs() {
    needed=$1
    shift
    for tool in "$@"; do installed "$tool" || { skip "$needed" "$tool is not installed"; return 1; }; done
}
# shellcheck disable=SC2034
empty='int main(void) { return 0; }'
compiles() {
    printf '%b\n' "$1" > "$scratch/has.c"
    with=$2
    shift 2
    $with "$scratch/has.c" "$@" -o "$scratch/has" > /dev/null 2>&1
}
finish() {
    echo "$1: $passed passed, $failed failed"
    [ $failed -eq 0 ]
    exit
}
