#!/bin/sh
# SPDX-License-Identifier: MIT
# The atlas: what the comments of sph_ops.h claim of operators is what it measures; false claims are found; its
# pages are whole: every link leads somewhere, nothing is loaded from elsewhere, every table has headers.
. tests/check.sh
atlas=$BUILD/examples/atlas_operators
if [ ! -x "$atlas" ]; then
    skip "the atlas" "$atlas is not built"
    finish atlas
    exit
fi
one() { # NAME [OPTIONS]: operators of this name
    name=$1
    shift
    "$atlas" -quiet -only "$name" -out "$scratch" -figures "$scratch" "$@"
}
check "claims of a gradient and a Laplacian hold" answers 0 " 0 differs" one cspm

# false claims, one each: of exactness, of an order, in words that are not known, and none at all
mkdir "$scratch/false"
false_claim() { # SED EXPRESSION, what is printed
    sed -e "$1" sph_ops.h > "$scratch/false/sph_ops.h" && ! cmp -s sph_ops.h "$scratch/false/sph_ops.h" &&
        answers 1 "$2" one gradient_cspm -headers "$scratch/false"
}
line='Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 2 inside'
check "too exact" false_claim "s/$line/Atlas: gradient exact for quadratic fields; order 2 inside/" "quadratic fields .*linear fields .*differs"
check "not exact enough" false_claim "s/$line/Atlas: gradient exact for constants, inside lattices for quadratic fields; order 2 inside/" "constants .*linear fields .*differs"
check "too high an order" false_claim "s/$line/Atlas: gradient exact for linear fields, inside lattices for quadratic fields; order 4 inside/" "order inside lattices .*differs"
check "words that are not known" false_claim "s/$line/Atlas: gradient exact for fun; order 2 inside/" "not understood"
check "no claim" false_claim "s/$line/Gradient/" "nothing is claimed"
check "another formula" false_claim 's/grad f_i = K^-1 sum_j V_j/grad f_i = K sum_j V_j/' "not in sph_ops.h"
check "no header" answers 2 "cannot read" one gradient_cspm -headers "$scratch/nowhere"

# pages
mkdir "$scratch/pages"
check "pages" answers 0 " 0 differs" one laplacian -pages "$scratch/pages"
check "no folder for pages" answers 2 "no/such/folder" one gradient_cspm -pages no/such/folder
cd "$scratch/pages" || exit 2
scratch=.. # of check
links() {
    grep -o -h -E '(src|href)="[^"]*"' ./*.html | sed 's/[^"]*"//; s/"$//' | sort -u | while read -r file; do [ -e "$file" ] || echo "$file"; done > ../lost
    ! grep . ../lost
}
check "every link leads somewhere" links
check "nothing is loaded from elsewhere" sh -c "! grep -n -i -E '(src|href|url|import)[=( \"]*(https?:)?//' ./*.html ./*.css"
check "a page for each operator" test "$(ls ./laplacian_*.html | wc -l)" -eq 5
check "a page has its equation" grep -q '<math display="block"><mi>L</mi>' laplacian_brookshaw.html
check "it has the comment of the header" grep -q 'L f_i = sum_j 2 V_j (f_i - f_j) F_ij. For source' laplacian_brookshaw.html
check "headers of tables have a scope" sh -c "! grep -n '<th>' ./*.html"
check "plots have names" sh -c "! grep '<svg viewBox' ./*.html | grep -v aria-label"
check "no number is missing" sh -c "! grep -n -i -w -E 'nan|-?inf' ./*.html"
# shellcheck disable=SC2016
whole='import sys
from html.parser import HTMLParser
single = {"meta", "link", "input", "path", "circle", "mspace"}
class Page(HTMLParser):
    def handle_starttag(self, tag, attributes):
        if tag not in single: self.open.append(tag)
    def handle_startendtag(self, tag, attributes):
        pass
    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (self.getpos(), tag, self.open[-3:])
        self.open.pop()
for name in sys.argv[1:]:
    page = Page()
    page.open = []
    page.feed(open(name).read())
    assert not page.open, (name, page.open)'
if needs "every tag is closed" python3; then check "every tag is closed" python3 -c "$whole" ./*.html; fi
finish atlas
