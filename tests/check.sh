# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# Sourced by the test scripts: counts checks.
#     check WHAT COMMAND ...      passes if the command succeeds; its output is shown if it fails
#     check WHAT answers STATUS TEXT COMMAND ...      passes if the command ends with that status (error: with any that is not 0, by itself) and prints that text
#     skip WHAT WHY               says aloud what is not tested
#     installed TOOL ...          succeeds if all of them are
#     needs WHAT TOOL ...         the same, and skips WHAT if not
#     $bounded COMMAND ...        ends it after a while, where there is timeout: an emulator may wait for ever
#     "$freely"       the flag by which the compiler inlines what it likes: half of the time to compile, or a third
#     "$one_copy"     and that by which it inlines nothing, for what makes many calls: seconds, not minutes
#     compiles TEXT COMPILER FLAGS ...
#         succeeds if that makes a program of the text ($empty: of an empty one); a COMPILER may be of
#         several words
#     runs TEXT RUNNERS COMPILER FLAGS ...
#         succeeds if that makes a program which also runs, with status 0: a compiler may be there, but not
#         what its programs need. RUNNERS: commands that are given the program, with a | between them, tried
#         in turn. '' is this machine, '|qemu-i386' this machine or else an emulator; with - it need not
#         run, where only what the compiler writes is read. $runner is then the one that ran it, or $why
#         says what is missing or went wrong
#     usable WHAT TEXT RUNNERS COMPILER FLAGS ...
#         the same, and skips WHAT if not
#     works WHAT COMMAND ...      succeeds if an installed tool does a simple thing, and skips WHAT if not
#     finish NAME
#         prints 'NAME: N passed, N failed' and ends with 1 if a check failed, or if there was none because
#         what is installed does not work
BUILD=${BUILD:-build}
CC=${CC:-cc}
# shellcheck disable=SC2034
freely='-DSPH_FN=static inline' one_copy='-DSPH_FN=static __attribute__((noinline, unused))'
scratch=$BUILD/scratch/$(basename "$0" .sh)
rm -rf "$scratch"
mkdir -p "$scratch" || exit 2
. examples/common/progress.sh
progress_begin "$(basename "$0" .sh)"
passed=0
failed=0
broken=0 # what is installed, and does not work
check() {
    what=$1
    shift
    progress $((passed + failed)) "$what"
    if "$@" > "$scratch/log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        progress_hide
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
skip() {
    progress_hide
    echo "skipped: $1: $2"
}
installed() {
    for tool in "$@"; do command -v "$tool" > /dev/null 2>&1 || return 1; done
}
needs() {
    needed=$1
    shift
    for tool in "$@"; do installed "$tool" || { skip "$needed" "$tool is not installed"; return 1; }; done
}
bounded=
installed timeout && bounded="timeout 300"
# shellcheck disable=SC2034
empty='int main(void) { return 0; }'
compiles() {
    printf '%b\n' "$1" > "$scratch/has.c"
    with=$2
    shift 2
    rm -f "$scratch/has.out"
    $with "$scratch/has.c" "$@" -o "$scratch/has.out" > "$scratch/has.log" 2>&1 < /dev/null
}
reason() { # the line of the last probe's output that says most, in few words
    { grep -i -e error -e cannot "$scratch/has.log"; grep . "$scratch/has.log"; } |
        LC_ALL=C tr -cd '[:print:]\n' | sed "s|$scratch/||g" | head -n 1 | cut -c 1-150 | grep . ||
        echo "it says nothing"
}
runs() {
    text=$1 runners=$2 why='' absent=1 maker=${3%% *}
    shift 2
    if ! installed "$maker"; then
        why="$maker is not installed"
        return 1
    fi
    if ! compiles "$text" "$@"; then
        why="$maker is installed, but makes no program: $(reason)" absent=0
        return 1
    fi
    while :; do
        runner=${runners%%|*}
        emulator=${runner%% *}
        [ "$runner" != - ] || return 0
        if [ "$runner" ] && ! installed "$emulator"; then
            said="$emulator is not installed"
        else
            # in scratch: what is no program for this machine may be read as a script
            (cd "$scratch" && $bounded sh -c "$runner ./has.out" > has.log 2>&1 < /dev/null) && return 0
            said="a program of $maker does not run${emulator:+ in $emulator} (status $?): $(reason)"
            absent=0
        fi
        why="$why${why:+; }$said"
        [ "$runner" != "$runners" ] || return 1
        runners=${runners#*|}
    done
}
usable() {
    unusable=$1
    shift
    runs "$@" && return
    skip "$unusable" "$why"
    [ $absent -eq 1 ] || broken=$((broken + 1))
    return 1
}
works() {
    unusable=$1
    shift
    "$@" > "$scratch/has.log" 2>&1 < /dev/null && return
    skip "$unusable" "it is installed, but does not work here: $(reason)"
    broken=$((broken + 1))
    return 1
}
finish() {
    progress $((passed + failed))
    progress_end
    if [ $((passed + failed)) -eq 0 ] && [ $broken -gt 0 ]; then
        echo "failed: $1: nothing was tested, and not for want of tools: what is installed does not work"
        failed=1
    fi
    echo "$1: $passed passed, $failed failed"
    [ $failed -eq 0 ]
    exit
}
