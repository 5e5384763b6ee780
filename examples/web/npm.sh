#!/bin/sh
# SPDX-License-Identifier: MIT
# Lays out the npm package of a module:  examples/web/npm.sh MODULE.wasm FOLDER      then: cd FOLDER && npm pack
set -e
mkdir -p "$2"
cp examples/web/npm/* examples/web/lab.js LICENSE "$2"
sed "s/@VERSION@/$(make -s --no-print-directory version)/" examples/web/npm/package.json > "$2/package.json"
{
    echo "module.exports = Uint8Array.from(atob(\`"
    base64 < "$1"
    echo "\`), c => c.charCodeAt(0));"
} > "$2/module.js"
