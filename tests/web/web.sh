#!/bin/sh
# SPDX-License-Identifier: MIT
# The laboratory of examples/web: its module against native programs, and its page in a headless Chromium. From the root of the repository.
. tests/check.sh
web="the laboratory (Debian: clang lld nodejs)"
if ! needs "$web" clang wasm-ld node || ! works "$web" node -e 0; then finish web; fi
check "the vector module compiles" nice sh examples/web/build.sh "$scratch/simd.wasm"
check "the scalar module compiles" nice sh examples/web/build.sh "$scratch/scalar.wasm" scalar
# without what tells the headers of vectors: they then add one number after the other, as the scalar module does
check "the native program compiles" nice "$CC" -std=c99 -O1 -U__SSE2__ '-DSPH_FN=static __attribute__((noinline, unused))' -ffp-contract=off -ffreestanding -fno-math-errno -DSPH_PURE_SQRT=0 \
    -Iexamples/web/freestanding -I. -Wall -Wextra -Wpedantic -Werror -Wno-unknown-warning-option -Wno-pass-failed tests/web/native.c examples/web/*.c -o "$scratch/native" -lm
for module in scalar simd; do sh examples/web/page.sh "$scratch/$module.wasm" > "$scratch/$module.html"; done
without=
if ! needs "the page" chromium || ! works "the page" chromium --version; then without=without-chromium; fi
if [ -e "$scratch/native" ] && [ -e "$scratch/scalar.wasm" ] && [ -e "$scratch/simd.wasm" ]; then
    timeout 300 node tests/web/web.js "$scratch/native" "$scratch/scalar.wasm" "$scratch/simd.wasm" "$scratch/scalar.html" "$scratch/simd.html" "$scratch/profile" $without > "$scratch/output" 2>&1
    status=$?
    cat "$scratch/output"
    check "the checks end" test $status -lt 2
fi
finish web-build
