#!/bin/sh
# SPDX-License-Identifier: MIT
# The atlas: what the comments of sph_ops.h claim of operators is what it measures; false claims are found; the
# pages that are kept say what table and comments say; pages are whole: every link leads somewhere, nothing is loaded from elsewhere, every table has headers.
. tests/check.sh
atlas=$BUILD/examples/atlas_operators
if [ ! -x "$atlas" ]; then
    skip "the atlas" "$atlas is not built"
    finish atlas
fi
pages=$scratch/pages false=$scratch/false
mkdir "$pages" "$false"
one() { # NAME [OPTIONS]: operators of this name
    name=$1
    shift
    "$atlas" -quiet -only "$name" -out "$scratch" -figures "$scratch" "$@"
}
# all of one kind hold; false claims, one for each of some functions, are found, and nothing else is
check "claims hold, and pages" answers 0 " 0 differs" one laplacian -pages "$pages"
claim() { # FUNCTION SED EXPRESSION: in the comment above it
    awk -v name="SPH_FN sph_index $1(" -v edit="$2" '
        index($0, name) == 1 { split(edit, part, "|"); if (index(comment, part[1])) sub(part[1], part[2], comment); else exit 1 }
        /^\/\*/ { comment = ""; on = 1 }
        on { comment = comment $0 "\n"; if (/\*\/ *$/) { on = 0; held = 1 } ; next }
        { printf "%s", comment; comment = ""; print }' "$false/sph_ops.h" > "$false/edited" && mv "$false/edited" "$false/sph_ops.h"
}
cp sph_ops.h "$false/sph_ops.h"
check "a claim of exactness" claim sph_gradient_cspm "exact for linear fields, inside|exact for quadratic fields, inside"
check "a claim of an order" claim sph_gradient_iad "; order 2|; order 4"
check "a claim in other words" claim sph_gradient_rk "exact for linear fields, inside|exact for straight fields, inside"
check "a claim that is taken away" claim sph_gradient_difference "Atlas: gradient|Gradient"
check "a formula" claim sph_gradient_symmetric "grad f_i = rho_i|grad f_i = 2 rho_i"
check "a claim in free words" claim sph_interpolate_mls "opening): exact for linear|opening): exact for quadratic"
check "false claims" answers 1 " 9 differs" one gradient_ -headers "$false"
found() { grep -q -e "$1.*,differs$" "$scratch/atlas_operators.csv"; }
check "too exact" found 'gradient_cspm,.*exact for,,quadratic fields,theory,linear fields'
check "too high an order" found 'gradient_iad,.*order inside lattices,,4,theory,2.0'
check "words that are not known" found 'gradient_rk,.*not understood'
check "no claim" found 'gradient_difference,.*nothing is claimed'
check "too exact, in free words" found 'gradient_mls,.*in the words of the comment.*,quadratic fields,theory,linear fields'
check "another formula" found 'gradient_symmetric,.*not in sph_ops.h'
check "no header" answers 2 "cannot read" one gradient_cspm -headers "$scratch/nowhere"

# pages; those of a full run are kept, and say what the table and the comments say now
kept=examples/atlas/pages
check "pages that are kept" answers 0 " 0 files" "$atlas" -kept $kept
none_left() {
    ls $kept/*.html | sed 's/.*\///; s/\.html$//' | grep -v -x -e index -e choose -e kernels | while read -r name; do grep -q "^    X($name, " examples/atlas/operators.h || echo "$name"; done > "$scratch/lost"
    ! grep . "$scratch/lost"
}
check "no page of an operator that is gone" none_left
cp sph_ops.h "$false/sph_ops.h"
check "a comment that changes" claim sph_gradient_cspm "grad f_i =|grad f_i  ="
check "its page is out of date" answers 1 "gradient_cspm.html does not say: .*grad f_i" "$atlas" -kept $kept -headers "$false"
check "no other is" answers 1 " 1 files" "$atlas" -kept $kept -headers "$false"
check "a claim that changes" claim sph_gravity_direct "energy is kept|energy never grows"
check "two pages are out of date" answers 1 " 2 files" "$atlas" -kept $kept -headers "$false"
check "it is no claim of what is kept" answers 1 " 1 differs" one gravity -headers "$false"
check "what is kept" found 'gravity_direct,.*what is kept,.*energy is kept.*,not what sph_ops.h says'
mkdir "$scratch/copy"
cp $kept/*.html $kept/atlas.css "$scratch/copy"
sed 's/Randles/Randle/' $kept/gradient_cspm.html > "$scratch/copy/gradient_cspm.html"
sed 's/>hessian_wls</>hessian_wls2</' $kept/choose.html > "$scratch/copy/choose.html"
rm "$scratch/copy/index.html"
check "pages that were changed or lost" answers 1 " 3 files" "$atlas" -kept "$scratch/copy"
cp $kept/gradient_cspm.html "$scratch/copy"
check "pages that can be mended" answers 1 " 4 files" "$atlas" -kept "$scratch/copy" -headers "$false" -mend
check "but not those of numbers" answers 1 " 2 files" "$atlas" -kept "$scratch/copy" -headers "$false"
check "its numbers stay" sh -c "sed '1,/<h2>Exact/d' $kept/gradient_cspm.html > '$scratch/numbers' && sed '1,/<h2>Exact/d' '$scratch/copy/gradient_cspm.html' | cmp - '$scratch/numbers'"
check "no folder for pages" answers 2 "no/such/folder" one gradient_cspm -pages no/such/folder
cd "$pages" || exit 2
scratch=.. # of check
links() {
    grep -o -h -E '(src|href)="[^"]*"' ./*.html | sed 's/[^"]*"//; s/"$//' | sort -u | while read -r file; do [ -e "$file" ] || echo "$file"; done > ../lost
    ! grep . ../lost
}
check "every link leads somewhere" links
check "nothing is loaded from elsewhere" sh -c "! grep -n -i -E '(src|href|url|import)[=( \"]*(https?:)?//' ./*.html ./*.css"
set -- ./laplacian_*.html
check "a page for each operator" test $# -eq 5
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
if needs "sorting and filters" chromium && works "sorting and filters" chromium --version; then
    sorted='<script>
    document.querySelectorAll("th button")[8].click();
    form.words.value = "WALL";
    choose();
    const rows = [...document.querySelectorAll("table.sort tbody tr")];
    document.title = rows[0].cells[0].textContent + ", " + rows.filter(row => !row.hidden).length + " shown";
    </script>'
    { cat index.html; echo "$sorted"; } > sorted.html
    check "sorting and filters" answers 0 "<title>laplacian_wls, 1 shown</title>" $bounded chromium --headless --no-sandbox --disable-gpu --dump-dom "file://$PWD/sorted.html"
fi
finish atlas
