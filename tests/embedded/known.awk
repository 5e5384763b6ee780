# SPDX-License-Identifier: MIT
# Known answers as C, for programs that cannot read a file: awk -f tests/embedded/known.awk tests/known/kernels.csv > known_answers.h
# Included with these two macros defined:
#     KERNEL(kernel, dim, sigma, and the largest magnitude of W, dWdr, F, d2Wdr2, dWdh for h = 1)
#     ANSWER(kernel, dim, h, r, W, dWdr, F, d2Wdr2, dWdh)
BEGIN {
    FS = ","
    print "/* generated from tests/known/kernels.csv */"
}
function magnitude(x) { sub(/^-/, "", x); return x }
/^#/ || /^kernel/ || NF != 10 { next }
{
    rows++
    name = toupper($1)
    gsub(/-/, "_", name)
    key = "SPH_" name ", " $2
    print "ANSWER(" key ", " $3 ", " $4 ", " $6 ", " $7 ", " $8 ", " $9 ", " $10 ")"
    if (!(key in sigma)) order[++keys] = key
    sigma[key] = $5
    for (q = 1; q <= 5; q++)
        if ($3 == 1 && magnitude($(5 + q)) + 0 >= largest[key, q] + 0) largest[key, q] = magnitude($(5 + q))
}
END {
    for (i = 1; i <= keys; i++) {
        line = "KERNEL(" order[i] ", " sigma[order[i]]
        for (q = 1; q <= 5; q++) line = line ", " largest[order[i], q]
        print line ")"
    }
    exit rows == 0
}
