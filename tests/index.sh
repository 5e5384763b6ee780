#!/bin/sh
# SPDX-License-Identifier: MIT
#
# index.sh - what the headers promise about themselves, from the repository's root:
#   every public function is named in the INDEX of its header, and every name there exists;
#   no header allocates, prints or touches errno; each ends with the licence;
#   no identifier is a word that OpenCL, CUDA, complex.h or windows.h has taken.
# HEADERS="a.h b.h" looks at others instead.

LC_ALL=C
export LC_ALL
headers=${HEADERS:-"sph_kernels.h sph_ops.h sph.h"}
passed=0
failed=0

good() { passed=$((passed + 1)); }
bad() {
    failed=$((failed + 1))
    echo "index.sh: failed: $1" >&2
}

# Each of the names $2 is one of $1.
named() {
    unknown=$(printf '%s\n' "$2" | grep -v -x -F -e "$1")
    for name in $unknown; do bad "$3: $name"; done
    # shellcheck disable=SC2086
    passed=$((passed + $(set -- $2; echo $#) - $(set -- $unknown; echo $#)))
}

# The code alone: comments, strings and character constants become a blank.
code() {
    awk '
    {
        line = $0; out = ""
        while (line != "") {
            if (inside) {
                end = index(line, "*/")
                if (!end) { line = ""; break }
                line = substr(line, end + 2); inside = 0; out = out " "
                continue
            }
            first = substr(line, 1, 1); two = substr(line, 1, 2)
            if (two == "/*") { inside = 1; line = substr(line, 3) }
            else if (two == "//") line = ""
            else if (first == "\"" || first == "\047") {
                line = substr(line, 2)
                while (line != "" && substr(line, 1, 1) != first) line = substr(line, substr(line, 1, 1) == "\\" ? 3 : 2)
                line = substr(line, 2); out = out " "
            } else { # as far as one of these may begin
                n = match(substr(line, 2), /[\/"\047]/)
                if (!n) n = length(line)
                out = out substr(line, 1, n); line = substr(line, n + 1)
            }
        }
        print out
    }' "$1"
}

# Of the opening comment, what stands under INDEX: up to the next line that starts with another title in capitals.
index_of() {
    awk '
    /^ \* INDEX/ { on = 1 }
    on && /^ \* [A-Z][A-Z][A-Z]/ && !/^ \* INDEX/ && !/^ \* *SPH_/ { exit }
    on { print }
    /\*\// { exit }' "$1"
}

# Public functions: SPH_FN at the start of a line, named sph_something.
functions_of() { # of code
    printf '%s\n' "$1" | sed -n 's/^SPH_FN[^(]*[ *]\(sph_[a-z0-9_]*\)(.*/\1/p'
}

types=$(for header in $headers; do code "$header"; done | sed -n -E 's/^(typedef [^{(]*[ *]|} )(sph_[a-z0-9_]*);.*/\2/p')
for header in $headers; do
    if [ ! -f "$header" ]; then
        bad "no $header"
        continue
    fi
    index=$(index_of "$header" | grep -o '[A-Za-z_][A-Za-z0-9_]*')
    code=$(code "$header")
    functions=$(functions_of "$code")

    [ -n "$functions" ] && good || bad "$header: no function found"
    named "$index" "$functions" "$header: not in the INDEX"
    # Names in the INDEX: macros and functions of this header, or types.
    macros=$(printf '%s\n' "$code" | sed -n 's/^# *define \(SPH_[A-Za-z0-9_]*\)[( ].*/\1/p')
    named "$macros
$functions
$types" "$(printf '%s\n' "$index" | grep -E '^(sph|SPH)_' | sort -u)" "$header: the INDEX has what does not exist"

    for word in malloc calloc realloc free printf fprintf puts exit abort errno; do
        if printf '%s\n' "$code" | grep -qw "$word"; then bad "$header: $word"; else good; fi
    done
    for file in stdio.h stdlib.h errno.h; do
        if printf '%s\n' "$code" | grep -q "# *include *<$file>"; then bad "$header: includes $file"; else good; fi
    done

    for word in kernel half local global constant private I min max near far small; do
        if printf '%s\n' "$code" | grep -qw "$word"; then
            bad "$header: the word $word: $(printf '%s\n' "$code" | grep -nw "$word" | head -n 1)"
        else good; fi
    done

    # The last comment of the file, without its frame.
    text=$(awk '/^\/\*$/ { n = 0; open = 1; next } /^ \*\/$/ { last = $0; done = NR; open = 0; next } open { line[++n] = $0 }
                END { if (done == NR) for (i = 1; i <= n; i++) { sub(/^ \* ?/, "", line[i]); print line[i] } }' "$header")
    if [ -n "$text" ] && [ "$text" = "$(cat LICENSE)" ]; then good; else bad "$header: does not end with the text of LICENSE"; fi

    if [ "$(head -n 1 "$header" | cut -c 1-31)" = "/* SPDX-License-Identifier: MIT" ]; then good; else bad "$header: no SPDX line"; fi
done

echo "index: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
