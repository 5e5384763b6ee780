#!/bin/sh
# SPDX-License-Identifier: MIT
# The README's two commands, and a few more, on a machine that has a compiler, GNU make and the usual Unix
# commands only: no git, Python, gnuplot or other compiler. In the checkout nothing is written; BUILD is elsewhere,
# and has a space. The tests and papers are a few quick ones: what is looked for here is what the commands take for granted.
. tests/check.sh
make=$(command -v gmake || command -v make)
here=$(cd "$scratch" && pwd)
bin=$here/bin copy=$here/checkout build="$here/a build"
mkdir -p "$bin" "$copy" "$here/tmp"
# POSIX's, and those of the compiler
for tool in awk basename cat chmod cksum cmp comm cp cut date dd df diff dirname echo env expr false find fold \
    grep head id join kill ln ls mkdir mv nl od paste pwd rm rmdir sed sh sleep sort tail tee test touch tr true tty \
    uname uniq wc xargs install mktemp seq timeout as ar ld nm ranlib size strip; do
    ! installed $tool || ln -s "$(command -v "$tool")" "$bin/$tool"
done
ln -s "$make" "$bin/make"
ln -s "$(command -v "${CC%% *}")" "$bin/${CC%% *}"
for f in *; do
    case $f in build) continue ;; esac # of other runs
    case $BUILD/ in "$f"/*) ;; *) cp -R "$f" "$copy" ;; esac
done
chmod -R a-w "$copy"
touch "$here/before"
sleep 1
# shellcheck disable=SC2317
bare() { # ARGUMENTS OF MAKE
    (cd "$copy" && env -i PATH="$bin" HOME="$here" TMPDIR="$here/tmp" make CC="$CC" BUILD="$build" "$@")
}
scripts="tests/index.sh tests/signatures.sh tests/readme.sh tests/precision.sh tests/known/derivation.sh"
scripts="$scripts tests/gsl.sh tests/petsc.sh"
check "make" answers 0 "make reproduce" bare
check "make test" answers 0 "^[1-9][0-9]* passed, 0 failed$" bare TESTS="gravity index_range" \
    TESTS_FLOAT=gravity TESTS_DOUBLE=common DRIVERS= TEST_SCRIPTS="$scripts" test
cp "$scratch/output" "$scratch/of_test"
check "make test: the programs have been run" grep -q '^test_gravity: [1-9][0-9]* passed, 0 failed$' "$scratch/of_test"
check "make test: Python is not there" grep -q '^skipped: .*python3 is not installed' "$scratch/of_test"
check "make reproduce" answers 0 "gnuplot is not installed" bare DRIVERS=icspm_uniform reproduce
check "make reproduce: a table" test -s "$build/results/icspm_uniform.csv"
! grep -i 'not found$' "$scratch/of_test" "$scratch/output" > "$scratch/not_found"
check "no command is missing: $(head -n 1 "$scratch/not_found")" test ! -s "$scratch/not_found"
check "make docs" answers 0 "doxygen is not installed" bare docs
check "make install" answers 0 "" bare PREFIX=/usr DESTDIR="$here/root" install
check "make install: the headers" cmp sph_ops.h "$here/root/usr/include/sph_ops.h"
check "make clean" answers 0 "" bare clean
check "make clean: nothing is left" test -z "$(ls "$build")"
find "$copy" -newer "$here/before" > "$scratch/written"
check "nothing is written in the checkout: $(head -n 1 "$scratch/written")" test ! -s "$scratch/written"
chmod -R u+w "$copy"
if needs "BSD make" bmake; then
    check "BSD make is told which make it takes" answers error "this Makefile is for GNU make" \
        env MAKEFLAGS= MFLAGS= bmake help
fi
finish bare
