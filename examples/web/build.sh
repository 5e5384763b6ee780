#!/bin/sh
# SPDX-License-Identifier: MIT
# The laboratory as one WebAssembly module: clang's wasm32 target and wasm-ld, no C library.
#     examples/web/build.sh OUT.wasm [simd]          from the root of the repository; BUILD: where objects go
# simd: with vector instructions, which all browsers have known since 2023. Without, results are those of a native
# program bit for bit.
set -e
out=$1
web=examples/web
flags="-O2"
[ "$2" != simd ] || flags="-O3 -msimd128 -mbulk-memory"
objects=$(mktemp -d "${TMPDIR:-/tmp}/lab.XXXXXX")
trap 'rm -rf "$objects"' EXIT
# linked by wasm-ld itself: clang's driver would run wasm-opt, where that is installed
for source in $web/*.c $web/freestanding/memory.c; do
    # shellcheck disable=SC2086
    clang --target=wasm32 -std=c99 $flags -ffp-contract=off -ffreestanding -fno-math-errno -nostdlibinc -isystem $web/freestanding -DSPH_PURE_SQRT=0 -I. -fvisibility=hidden \
        -Wall -Wextra -Wno-pass-failed $LAB_CFLAGS -c "$source" -o "$objects/$(basename "$source" .c).o"
done
wasm-ld --no-entry --export-dynamic --strip-all -z stack-size=262144 "$objects"/*.o -o "$out"
