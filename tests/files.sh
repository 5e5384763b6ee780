#!/bin/sh
# SPDX-License-Identifier: MIT
# What the examples write, read back: every VTK file has a vertex for each point, which is what ParaView
# draws, and named arrays of finite numbers; every table has as many fields in each line; names of folders may
# have spaces and quotes in them. All files have the same bytes where a host has chosen a locale with decimal
# commas.
. tests/check.sh
bin=$BUILD/examples
reader=$scratch/read_files
warn="-Wall -Wextra -Wpedantic -Werror"
# shellcheck disable=SC2086
check "the reader compiles" "$CC" -std=c99 $warn -O1 tests/read_files.c -o "$reader" -lm

# ---- a host that has called setlocale, and a locale with decimal commas ----

cat > "$scratch/host.c" << 'END'
#include <locale.h>
#include <stdlib.h>
#include <string.h>
int program_main(int argc, char **argv);
int main(int argc, char **argv)
{
    const char *const name = getenv("HOST_LOCALE");
    if (name && (!setlocale(LC_ALL, name) || strcmp(localeconv()->decimal_point, ",") != 0)) return 99;
    return argc > 1 ? program_main(argc, argv) : 0;
}
END
echo 'int program_main(int argc, char **argv) { return argv[0][0] + argc < 0; }' > "$scratch/nothing.c"
check "a host compiles" "$CC" -std=c99 "$scratch/host.c" "$scratch/nothing.c" -o "$scratch/host"
comma=
for name in de_DE.UTF-8 de_DE.utf8 fr_FR.UTF-8 de_DE; do
    [ "$comma" ] || ! HOST_LOCALE=$name "$scratch/host" || comma=$name
done
if [ ! "$comma" ] && installed localedef; then
    mkdir -p "$scratch/locale"
    LOCPATH=$(cd "$scratch/locale" && pwd)
    export LOCPATH
    localedef -i de_DE -f UTF-8 "$LOCPATH/de_DE.UTF-8" > /dev/null 2>&1
    ! HOST_LOCALE=de_DE.UTF-8 "$scratch/host" || comma=de_DE.UTF-8
fi
if [ ! "$comma" ]; then # musl has made-up names, and a point in all of them
    if [ -e "$scratch/locale/de_DE.UTF-8/LC_NUMERIC" ]; then
        skip "decimal commas" "the C library of $CC has none, not on this machine"
    else skip "decimal commas" "no such locale is installed, and none can be made (Debian: locales)"; fi
fi

host() { # NAME SOURCE: compiles it with that host
    "$CC" -std=c99 -I. -O1 "$one_copy" -Dmain=program_main -c "$2" -o "$scratch/$1.o" &&
        "$CC" -std=c99 "$scratch/$1.o" "$scratch/host.c" -o "$scratch/$1" -lm
}
same() { # FOLDER FOLDER: the same files
    ls "$1" > "$scratch/one" && ls "$2" > "$scratch/other" && cmp "$scratch/one" "$scratch/other" || return 1
    for f in "$1"/*; do [ ! -e "$f" ] || cmp "$f" "$2/${f##*/}" || return 1; done
}
# NAME OPTIONS: runs it in two folders, without and with the locale. @ stands for the folder.
in_both() {
    program=$1
    shift
    for where in point comma; do
        folder="$scratch/$program's files/$where"
        mkdir -p "$folder"
        [ $where = point ] || [ "$comma" ] || continue
        (
            [ $where = point ] || export HOST_LOCALE="$comma"
            for option in "$@"; do
                shift
                case $option in @*) option=$folder${option#@} ;; esac
                set -- "$@" "$option"
            done
            "$scratch/$program" "$@"
        ) || return 1
    done
    for f in "$scratch/$program's files"/*/*.csv; do # without the times of the run
        [ -e "$f" ] || continue
        grep -v '^run,,' "$f" > "$scratch/table"
        cp "$scratch/table" "$f"
    done
    [ ! "$comma" ] || same "$scratch/$program's files/point" "$scratch/$program's files/comma"
}
all_of() { # FOLDER ENDING ...: the reader takes all files of it, and there is one of each ending
    in=$1
    shift
    for ending in "$@"; do
        set -- "$in"/*."$ending"
        [ -e "$1" ] || { echo "no .$ending"; return 1; }
        "$reader" "$@" || return 1
    done
}

# ---- the examples of one file ----

# one of them is run, and all have its function `save`, but for what it calls
save_of() {
    sed -n '/^static int save(/,/^}/p' "$1" |
        sed -e 's/^    const int failed = /    /' -e 's/^    [a-z]*([^()]*);$/    run();/' \
            -e 's/return failed;/return 0;/'
}
save_of examples/drop_3d.c > "$scratch/save"
check "what is compared is a function" grep -q 'setlocale.*"wb"' "$scratch/save"
for f in examples/*.c; do
    save_of "$f" > "$scratch/other"
    check "$f saves as drop_3d does" cmp "$scratch/save" "$scratch/other"
done
sed 's/fill(9)/fill(3)/' examples/drop_3d.c > "$scratch/drop_small.c"
check "drop_3d compiles" host drop_3d "$scratch/drop_small.c"
check "drop_3d -v, in every locale" in_both drop_3d -v @/drop
check "drop_3d -o, in every locale" in_both drop_3d -o "@/drop 3d.csv"
drop="$scratch/drop_3d's files/point"
check "drop_3d's files" all_of "$drop" vtk csv
check "drop_3d writes 21 pictures" test -e "$drop/drop_020.vtk" -a ! -e "$drop/drop_021.vtk"

# ---- what a host may include, and a driver ----

cat > "$scratch/common.c" << 'END'
#include "examples/common/options.h"
#include "examples/common/report.h"
#include "examples/common/vtk.h"
int main(int argc, char **argv)
{
    static const double x[] = {0.5, -1.25e-7, 1e300}, y[] = {1.5, 0, -3};
    static const unsigned char kind[] = {0, 7, 255};
    const vtk_field fields[] = {
        {"velocity", x, y, NULL, NULL}, {"density", y, NULL, NULL, NULL}, {"kind", NULL, NULL, NULL, kind}};
    static report r;
    double value = 0;
    const option_spec spec = {"x", "a number", OPTION_REAL, &value, 0.25, 2.5};
    vtk_series s;
    int k;
    if (argc != 2 || !option_set(&spec, "1.5") || value != 1.5 || option_set(&spec, "1,5")) return 1;
    for (k = 0; k < 2; k++) { /* the second goes on from the first */
        vtk_series_begin(&s, argv[1], "a & b");
        vtk_series_resume(&s, 0.75);
        if (s.count != 2 * k) return 2;
        if (k == 0 && !vtk_series_add(&s, 0.125, 3, x, y, NULL, fields, 3)) return 3;
        if (k == 0 && !vtk_series_add(&s, 0.5, 3, x, y, x, fields, 3)) return 3;
        if (!vtk_series_add(&s, 0.75, 3, x, y, NULL, fields, 3)) return 3;
        vtk_series_end(&s);
    }
    report_open(&r, "table", argv[1]);
    r.screen = fopen("/dev/null", "w");
    report_relative(&r, "item", "a, b", "x", 0.5, 0.50001, 1e-3);
    report_absolute(&r, "item", "", "x", 0.5, 0.50001, 1.5e-3);
    report_range(&r, "item", "", "x", (double)NAN, 0.50001, 0.25, 0.75);
    report_band(&r, "item", "", "x", 0.5, 0.50001, 0.25, 0.75, REPORT_DIFFERS, "");
    return report_close(&r);
}
END
check "common compiles" host common "$scratch/common.c"
check "tables and VTK series, in every locale" in_both common @
check "their files" all_of "$scratch/common's files/point" vtu pvd csv
check "numbers compile" host numbers tests/test_common.c
check "numbers are read and written alike" in_both numbers @
check "elliptic_slit compiles" host elliptic_slit examples/papers/elliptic_slit.c
check "a driver's table and figure, in every locale" in_both elliptic_slit -out @ -figures @
check "its files" all_of "$scratch/elliptic_slit's files/point" csv
numbers() {
    ! grep -n -w -e fopen -e strtod -e atof -e sscanf -e fscanf "$@" |
        grep -v -e '/part_file.h:' -e '/number.h:' -e 'fopen(path, "rb*")'
}
check "no other way to files and numbers" numbers examples/[!h]*/*.[ch]

# ---- the drivers that write VTK ----

pictures() { # DRIVER OPTIONS ...: it runs until it has written some
    folder="$scratch/$1's files"
    driver=$1
    shift
    mkdir -p "$folder"
    "$bin/$driver" "$@" -out "$folder" -figures "$folder" > "$scratch/output" 2>&1 &
    process=$!
    seconds=0
    while ! ls "$folder"/*.pvd > /dev/null 2>&1 && [ $seconds -lt 60 ] && kill -0 $process 2> /dev/null; do
        sleep 1
        seconds=$((seconds + 1))
    done
    kill $process 2> /dev/null
    wait $process
    all_of "$folder" vtu pvd
}
for d in "$bin"/*_*; do # those that were built
    [ -x "$d" ] || continue
    d=${d##*/}
    "$bin/$d" -h | grep -q -e '^  -vtk' || continue
    case $d in
    cleaning_collapse) set -- -particles 100 -vtk 0.001 ;;
    cleaning_advection | cleaning_orszag_tang) set -- -vtk -side 8 ;;
    clustering_dam3d) set -- -vtk -resolution 2 ;;
    clustering_cavity | fluids_*) set -- -vtk ;;
    *) set -- -vtk -kernel wendland-c2 -tend 0.002 ;;
    esac
    check "$d's pictures" pictures "$d" "$@"
done
[ -x "$bin/clustering_box" ] || skip "the drivers' pictures" "$bin/clustering_box is not built"
writers() { [ "$(grep -l -e 'VTKFile type' -e 'vtk DataFile' -r examples | sort | tr '\n' ' ')" = "$1" ]; }
check "nobody else writes VTK" writers "examples/common/vtk.h examples/drop_3d.c "

# ---- the library of ParaView ----

# shellcheck disable=SC2016
view='import os, sys, vtk
for path in sys.argv[1:]:
    legacy = path.endswith(".vtk")
    reader = vtk.vtkPolyDataReader() if legacy else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    seen = reader.GetOutput()
    vertices = sum(seen.GetCellType(i) == vtk.VTK_VERTEX for i in range(seen.GetNumberOfCells()))
    words = ["%s: %d points, %d vertices" % (path, seen.GetNumberOfPoints(), vertices)]
    arrays = seen.GetPointData()
    for i in range(arrays.GetNumberOfArrays()):
        assert arrays.GetArray(i).GetNumberOfTuples() == seen.GetNumberOfPoints()
        words.append("%s %d" % (arrays.GetArrayName(i), arrays.GetArray(i).GetNumberOfComponents()))
    print(", ".join(words))'
python=
for name in python3 /usr/bin/python3; do
    [ "$python" ] || ! "$name" -c 'import vtk' 2> /dev/null || python=$name
done
seen_by_vtk() { # what the library sees is what the reader does
    "$reader" "$@" > "$scratch/one" && "$python" -c "$view" "$@" > "$scratch/other" &&
        diff "$scratch/one" "$scratch/other"
}
if [ "$python" ]; then
    set -- "$drop"/*.vtk
    for folder in "$scratch"/*"'s files" "$scratch/common's files/point"; do
        for f in "$folder"/*_0000.vtu; do [ ! -e "$f" ] || set -- "$@" "$f"; done
    done
    check "the library of ParaView" seen_by_vtk "$@"
else skip "the library of ParaView" "vtk for Python is not installed (Debian: python3-vtk9)"; fi

# ---- figures in folders of such names ----

if needs "figures" gnuplot; then
    figures="$scratch/elliptic_slit's files/point"
    check "a figure" gnuplot -c examples/papers/elliptic.gp "$figures"
    check "a figure lies beside its data" test -s "$figures/elliptic_table1.png"
fi

# ---- the reader finds what it is there for ----

refused() { # TEXT ENDING: the reader refuses what comes in, and says that
    cat > "$scratch/bad.$2"
    answers 1 "wrong: $1" "$reader" "$scratch/bad.$2"
}
good="$scratch/common's files/point/a & b_0000.vtu"
changed() { sed "$2" "$good" | refused "$1" vtu; }
check "no cells" changed "0 cells" 's/NumberOfCells="3"/NumberOfCells="0"/'
check "decimal commas" changed "no number" 's/^1\.5$/1,5/'
check "a name of two words" changed "'div B' is not one word" 's/"density"/"div B"/'
check "no name" changed "an array without a name" 's/"density"/""/'
check "a number too few" changed "no number" '/^-3$/d'
check "a number too many" changed "it goes on" 's/^-3$/-3 4/'
check "no number" changed "a number is nan" 's/^-3$/nan/'
check "half of a file" changed "it goes on" '/<.PointData>/,$d'
check "another vertex" changed "1 in the place of 2" '/offsets/,/types/s/^2$/1/'
points='# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 1 double\n0 0 0\n'
pressure='POINT_DATA 1\nSCALARS p double 1\nLOOKUP_TABLE default\n1\n'
legacy() { printf '%b' "$points$1$pressure" | refused "$2" vtk; }
check "points without vertices" legacy '' "1 points, 0 vertices"
check "a vertex of no point" legacy 'VERTICES 1 2\n1 1\n' "1 in the place of 0"
table() { printf '%b' "$1" | refused "$2" csv; }
check "decimal commas in a table" table 'a,b\n1,5,2\n' "line 2 has 3 fields, not 2"
check "other line ends" table 'a,b\r\n1,2\r\n' "line 1 has a line end of its own"
finish files
