#!/bin/sh
# SPDX-License-Identifier: MIT
# Faults in the middle of a run: a program that is killed leaves the old files or the new ones, never half of one; a full disk, a folder where nobody may write and memory that does not do each get a clear error
# and an exit status that is not 0.
. tests/check.sh
bin=$BUILD/examples

# ---- killed ----

# Snapshots as fast as they can be written: VTK files and their list, a table, a figure.
cat > "$scratch/snapshots.c" << 'END'
#include "examples/common/figure.h"
#include "examples/common/report.h"
#include "examples/common/vtk.h"
int main(int argc, char **argv)
{
    enum { N = 3000 };
    static double x[N];
    static char text[N];
    int i;
    (void)argc;
    memset(text, 'x', N - 1);
    for (;;) {
        vtk_series s;
        report r;
        FILE *f = figure_open(argv[1], "figure");
        for (i = 0; i < N; i++) fprintf(f, "%d\n", i);
        figure_close(f);
        report_open(&r, "table", argv[1]);
        r.screen = fopen("/dev/null", "w");
        for (i = 0; i < 300; i++) report_info(&r, "item", "setting", "quantity", i);
        report_close(&r);
        fclose(r.screen);
        vtk_series_begin(&s, argv[1], "series");
        for (i = 0; i < 3; i++) if (!vtk_series_add(&s, i, N, x, x, x, NULL, 0)) return 1;
        vtk_series_end(&s);
    }
}
END
check "a program that writes snapshots" "$CC" -std=c99 -I. -O1 "$scratch/snapshots.c" -o "$scratch/snapshots" -lm
whole() { # those files that are there
    folder=$1
    for f in "$folder"/*.vtu "$folder"/*.pvd; do
        [ ! -e "$f" ] || [ "$(tail -n 1 "$f")" = "</VTKFile>" ] || { echo "half of $f"; return 1; }
    done
    [ ! -e "$folder/figure.csv" ] || [ "$(wc -l < "$folder/figure.csv")" -eq 3000 ] || { echo "half of a figure"; return 1; }
    [ ! -e "$folder/table.csv" ] || { [ "$(wc -l < "$folder/table.csv")" -eq 303 ] && tail -n 1 "$folder/table.csv" | grep -q '^run,,wall time'; } || { echo "half of a table"; return 1; }
}
mkdir -p "$scratch/killed"
halves=0
for ms in 011 013 017 023 031 041 053 067 083 101 127 157; do # the snapshots of the one before are the old ones
    timeout -s KILL 0.$ms "$scratch/snapshots" "$scratch/killed" > /dev/null 2>&1
    check "killed after $ms ms" whole "$scratch/killed"
    for f in "$scratch"/killed/*.part; do [ -e "$f" ] && halves=$((halves + 1)); done
done
check "it was hit while it wrote" test $halves -gt 0
check "there are snapshots to be half" test -e "$scratch/killed/series.pvd"
halves() { sed -n '1,100p' "$1/figure.csv" > "$1/half" && mv "$1/half" "$1/figure.csv" && ! whole "$1"; }
check "half of a file would be noticed" halves "$scratch/killed"

if [ -x "$bin/icspm_uniform" ]; then
    mkdir -p "$scratch/driver"
    echo old > "$scratch/driver/icspm_uniform.csv"
    old_or_new() { [ "$(cat "$scratch/driver/icspm_uniform.csv")" = old ] || grep -q '^run,,wall time' "$scratch/driver/icspm_uniform.csv"; }
    for ms in 010 040 090; do
        timeout -s KILL 0.$ms "$bin/icspm_uniform" -out "$scratch/driver" -figures "$scratch/driver" > /dev/null 2>&1
        check "a driver killed after $ms ms" old_or_new
    done
else skip "a driver killed" "$bin/icspm_uniform is not built"; fi

# ---- a full disk, and no permission ----

mkdir -p "$scratch/full"
if [ -c /dev/full ] && [ -x "$bin/icspm_uniform" ]; then
    ln -s /dev/full "$scratch/full/icspm_uniform.csv.part" # what is written to it finds no space
    check "a full disk" answers 2 "No space" "$bin/icspm_uniform" -out "$scratch/full" -figures "$scratch"
    check "no table of that name" test ! -e "$scratch/full/icspm_uniform.csv"
    ln -s /dev/full "$scratch/full/icspm_fig2.csv.part"
    check "a full disk for figures" answers 2 "No space" "$bin/icspm_uniform" -out "$scratch" -figures "$scratch/full"
    check "no figure of that name" test ! -e "$scratch/full/icspm_fig2.csv"
else skip "a full disk" "no /dev/full, or $bin/icspm_uniform is not built"; fi
forbidden= # a folder in which not even root may write, or one that was made so
if [ -d /sys/kernel ]; then forbidden=/sys/kernel
elif [ "$(id -u)" -ne 0 ]; then
    forbidden=$scratch/forbidden
    mkdir -p "$forbidden"
    chmod 555 "$forbidden"
fi
echo "a file" > "$scratch/file"
for d in $(cd "$bin" && ls | grep _); do
    check "a file for a folder" answers 2 "$scratch/file" "$bin/$d" -out "$scratch/file"
    [ -n "$forbidden" ] && check "no permission" answers 2 "$forbidden" "$bin/$d" -out "$forbidden"
    [ -n "$forbidden" ] && check "no permission for figures" answers 2 "$forbidden" "$bin/$d" -out "$scratch" -figures "$forbidden"
done
[ -n "$forbidden" ] || skip "no permission" "root may write everywhere, and there is no /sys"

# ---- memory ----

starved() { # KILOBYTES COMMAND...
    limit=$1
    shift
    (
        ulimit -v "$limit" || exit 0
        exec timeout 20 "$@"
    )
}
if (ulimit -v 100000) 2> /dev/null; then
    for d in "icspm_random -small 1000000" "elliptic_uses" "cleaning_orszag_tang -side 4096" "clustering_dam3d"; do
        [ -x "$bin/${d%% *}" ] || continue
        case $d in icspm*) limit=20000 ;; cleaning*) limit=60000 ;; clustering*) limit=9000 ;; *) limit=7000 ;; esac
        # shellcheck disable=SC2086
        check "$d, starved of memory" answers error "memory" starved $limit "$bin/"$d -out "$scratch" -figures "$scratch"
    done
else skip "no memory" "there is no ulimit -v"; fi
finish faults
