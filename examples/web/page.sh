#!/bin/sh
# SPDX-License-Identifier: MIT
# Puts a module and the scripts into the page:  examples/web/page.sh MODULE.wasm > OUT.html
while IFS= read -r line; do
    case $line in
    @MODULE@) base64 < "$1" ;;
    @LAB@) cat examples/web/lab.js ;;
    @PAGE@) cat examples/web/page.js ;;
    *) printf '%s\n' "$line" ;;
    esac
done < examples/web/page.html
