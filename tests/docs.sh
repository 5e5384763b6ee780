#!/bin/sh
# SPDX-License-Identifier: MIT
# The pages of make docs. Doxygen warns of nothing. Every Markdown file has a page. Pictures show, and links
# within the pages lead somewhere. A header's page and a chapter's begin with their text. Every public
# function has a text, and every parameter is explained: in that text, by the SYMBOLS of the manual of
# sph_ops.h, or by its type, if that is a struct or enum of the headers.
. tests/check.sh
if ! needs "the pages" doxygen || ! works "the pages" doxygen --version; then finish docs; fi
check "doxygen warns of nothing" make -s docs BUILD="$scratch" \
    DOXYGEN="GENERATE_XML=YES XML_PROGRAMLISTING=NO"
html=$scratch/docs/html xml=$scratch/docs/xml

for page in *.md examples/*.md examples/*/*.md tests/*.md; do
    check "$page has a page" grep -q -e "[ /]$page\\>" docs/Doxyfile
done

# what the pages show (src) or lead to (href), and what of that is not there
grep -o -h -E '(src|href)="[^"#:]+["#]' "$html"/*.html | sed 's/[^"]*"//; s/["#]$//' | sort -u |
    while read -r file; do test -e "$html/$file" || echo "$file"; done > "$scratch/lost"
check "the main page has its picture" grep -q '<img src="icspm_fig2.png"' "$html/index.html"
check "nothing is lost" sh -c "! grep . '$scratch/lost'"

for page in sph_8h sph__ops_8h sph__kernels_8h group__sph__ops__h8; do
    grep -o -e 'name="details"' -e 'class="memberdecls"' "$html/$page.html" > "$scratch/order"
    check "$page begins with its text" sh -c "head -n 1 '$scratch/order' | grep details"
done

# public functions, each with the faults of its description
awk '/^ \* SYMBOLS/ { on = 1; next } on && /^ \* [A-Z]/ { exit } on' sph_ops.h > "$scratch/symbols"
cat "$xml"/group__*.xml "$xml"/sph*_8h.xml | awk -v symbols="$scratch/symbols" '
    function words(text, into, n, i, part) {
        n = split(text, part, /[^A-Za-z0-9_]+/)
        for (i = 1; i <= n; i++) into[part[i]]
    }
    function explained(name, type) {
        if (name in own || name in known || type ~ /^sph_/ && !(type in number)) return 1
        sub(/_[ij]$/, "", name)
        return name in known
    }
    BEGIN {
        while ((getline line < symbols) > 0) words(line, known)
        words("sph_real sph_index sph_vec sph_sym sph_scalars sph_vectors sph_points", number)
    }
    /<memberdef kind="function"/ { on = 1; name = text = ""; count = 0 }
    !on { next }
    /<name>/ && name == "" { name = $0; gsub(/.*<name>|<\/name>.*/, "", name) }
    /<type>/ {
        type = $0
        gsub(/<[^>]*>/, "", type)
        sub(/.*[ *]sph_/, "sph_", type)
        sub(/[ *].*/, "", type)
    }
    /<declname>/ { gsub(/ *<[^>]*>/, ""); parameter[++count] = $0; types[count] = type }
    /<(brief|detailed)description>/ { describes = 1 }
    describes { line = $0; gsub(/<[^>]*>/, " ", line); text = text " " line }
    /<\/(brief|detailed)description>/ { describes = 0 }
    /<\/memberdef>/ {
        on = 0
        if (name !~ /^sph_/ || name in done) next
        done[name]
        faults = text ~ /[A-Za-z]/ ? "" : " has no text;"
        split("", own)
        words(text, own)
        for (i = 1; i <= count; i++)
            if (!explained(parameter[i], types[i])) faults = faults " says nothing of " parameter[i] ";"
        print name faults
    }' > "$scratch/functions"
check "the pages have every public function" test "$(wc -l < "$scratch/functions")" -eq \
    "$(cat sph_kernels.h sph_ops.h sph.h | grep -c '^SPH_FN.*[ *]sph_[a-z0-9_]*(')"
check "every public function has a text that explains its parameters" sh -c "! grep ' ' '$scratch/functions'"
finish docs
