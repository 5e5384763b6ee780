#!/bin/sh
# SPDX-License-Identifier: MIT
# The laboratory as one WebAssembly module: clang's wasm32 target and wasm-ld, no C library.
#     examples/web/build.sh OUT.wasm [scalar]        from the root of the repository
# It has vector instructions, which all browsers have known since 2023. scalar: without them, and without inlining,
# to compile in seconds; its results are those of a native program bit for bit.
set -e
web=examples/web
objects=$(mktemp -d "${TMPDIR:-/tmp}/lab.XXXXXX")
trap 'rm -rf "$objects"' EXIT
compile() { # FLAGS ...
    for source in "$web"/*.c "$web"/freestanding/memory.c; do
        clang --target=wasm32 -std=c99 -ffp-contract=off -ffreestanding -fno-math-errno -nostdlibinc -isystem $web/freestanding -DSPH_PURE_SQRT=0 -I. -fvisibility=hidden \
            -Wall -Wextra -Wpedantic -Wno-pass-failed "$@" -c "$source" -o "$objects/$(basename "$source" .c).o"
    done
}
if [ "$2" = scalar ]; then compile -O1 '-DSPH_FN=static __attribute__((noinline, unused))'; else compile -O3 -msimd128 -mbulk-memory; fi
# linked by wasm-ld itself: clang's driver would run wasm-opt, where that is installed
wasm-ld --no-entry --export-dynamic --strip-all -z stack-size=262144 "$objects"/*.o -o "$1"
