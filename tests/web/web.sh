#!/bin/sh
# SPDX-License-Identifier: MIT
# The laboratory of examples/web: its module against native programs, and its page in a headless Chromium. From the root of the repository.
. tests/check.sh
web="the laboratory (Debian: clang lld nodejs)"
if ! needs "$web" clang wasm-ld node || ! works "$web" node -e 0; then finish web; fi
check "the vector module compiles" nice sh examples/web/build.sh "$scratch/simd.wasm"
check "the scalar module compiles" nice sh examples/web/build.sh "$scratch/scalar.wasm" scalar
# without what tells the headers of vectors: they then add one number after the other, as the scalar module does
check "the native program compiles" nice "$CC" -std=c99 -O1 -U__SSE2__ "$one_copy" -ffp-contract=off -ffreestanding -fno-math-errno -DSPH_PURE_SQRT=0 \
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

# another browser: a picture of the page; without scripts or without the module it takes 54 kB
firefox=firefox
installed firefox-esr && firefox=firefox-esr
if [ -e "$scratch/simd.wasm" ] && needs "the page in Firefox (Debian: firefox-esr)" $firefox && works "the page in Firefox" $firefox --version; then
    mkdir -p "$scratch/firefox"
    here=$(cd "$scratch" && pwd)
    check "the page in Firefox" $bounded $firefox --headless --no-remote --profile "$here/firefox" --window-size=1280,900 --screenshot "$here/firefox.png" "file://$here/simd.html"
    check "Firefox draws" test "$(wc -c < "$scratch/firefox.png")" -gt 80000
fi

package="the npm package (Debian: npm)"
if needs "$package" npm && works "$package" npm --version && [ -e "$scratch/native" ] && [ -e "$scratch/simd.wasm" ]; then
    # the cache is of this run, and nothing is asked of a registry
    npm="npm --offline --no-audit --no-fund --no-update-notifier --cache $(cd "$scratch" && pwd)/npm-cache"
    mkdir -p "$scratch/host"
    echo '{ "private": true }' > "$scratch/host/package.json"
    check "the npm package is laid out" sh examples/web/npm.sh "$scratch/simd.wasm" "$scratch/package"
    check "npm pack" sh -c "cd '$scratch/package' && $npm pack"
    check "npm install without a network" sh -c "cd '$scratch/host' && $npm install ../package/sph-lab-*.tgz"
    cp tests/web/npm.js tests/web/types.ts "$scratch/host"
    (cd "$scratch/host" && node npm.js ../native) > "$scratch/output" 2>&1
    status=$?
    cat "$scratch/output"
    check "a program that has installed it ends" test $status -lt 2
    if needs "its types (Debian: node-typescript)" tsc; then
        check "its types" sh -c "cd '$scratch/host' && tsc --strict --noEmit --target es2022 --module node16 --moduleResolution node16 types.ts"
    fi
fi
finish web-build
