#!/bin/sh
# SPDX-License-Identifier: MIT
# Prints a C source with a small function for each function that takes arrays and whose name matches PATTERN, and
# for each DIM: one call of it, with a constant kernel and dimension, and options of zeros, as in a user's file.
# Compiled with all warnings, it tells what users see.
#     tests/compile/calls.sh PREFIX PATTERN DIM ...           from the root of the repository
prefix=$1 pattern=$2
shift 2
sh tests/prototypes.sh | awk -F '|' -v prefix="$prefix" -v pattern="$pattern" -v dims="$*" '
    BEGIN {
        print "#include \"sph.h\"\n#ifdef __cplusplus\n#define ZEROS {}\n#else\n#define ZEROS {0}\n#endif"
        all = split(dims, each, " ")
    }
    $3 !~ /sph_cloud |sph_grid |void \*/ || $2 == "sph_cloud_range" || $2 !~ pattern { next }
    {
        n = split($3, a, ","); parameters = arguments = locals = ""; of_dim = 0
        for (i = 1; i <= n; i++) {
            gsub(/^ +| +$/, "", a[i]); name = a[i]; sub(/.*[ *]/, "", name)
            if (a[i] == "sph_kernel k") name = "SPH_WENDLAND_C4"
            else if (a[i] == "int dim") { name = "DIM"; of_dim = 1 }
            else if (a[i] ~ /_options options$/) locals = locals "    " a[i] " = ZEROS;\n"
            else parameters = parameters (parameters == "" ? "" : ", ") a[i]
            arguments = arguments (i > 1 ? ", " : "") name
        }
        for (d = 1; d <= (of_dim ? all : 1); d++) {
            call = arguments
            sub(/DIM/, each[d], call)
            f = $1 prefix "_" $2 "_" each[d] "(" parameters ")"
            print f ";\n" f "\n{\n" locals "    return " $2 "(" call ");\n}"
        }
    }'
