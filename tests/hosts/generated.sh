#!/bin/sh
# SPDX-License-Identifier: MIT
# The files that examples/hosts/generate.py writes are those that are checked in: a prototype, struct or enum of
# the headers may have changed since. From the root of the repository.
. tests/check.sh
generate=examples/hosts/generate.py
export PYTHONDONTWRITEBYTECODE=1
# shellcheck disable=SC2317
same() {
    (cd "$scratch/new" && find . -type f) > "$scratch/files"
    while read -r file; do
        cmp "$scratch/new/$file" "examples/hosts/$file" || { echo "run: python3 $generate"; return 1; }
    done < "$scratch/files"
}
if needs "generated files of the hosts" python3 && works "generated files of the hosts" python3 -S -c ''; then
    check "$generate runs" python3 -S $generate "$scratch/new"
    check "what it writes is checked in" same
    check "it wrote something" test -s "$scratch/new/sph_shim_sweeps.h" -a -s "$scratch/new/sph/c.py" -a -s "$scratch/new/sph_c.f90"
fi
finish generated
