#!/bin/sh
# SPDX-License-Identifier: MIT
# The drivers as programs: help, wrong use (a clear error and exit status 2), and a short run whose table has its columns and its verdicts.
. tests/check.sh
bin=$BUILD/examples

for d in $(cd "$bin" && ls | grep _); do # those that were built
    check "help" answers 0 "-out" "$bin/$d" -h
    check "unknown option" answers 2 "-nonsense" "$bin/$d" -nonsense
    check "missing value" answers 2 "-out" "$bin/$d" -out
    check "no folder" answers 2 "no/such/folder" "$bin/$d" -out no/such/folder
    check "no folder" answers 2 "no/such/folder" "$bin/$d" -out "$scratch" -figures no/such/folder
done
check "a file that is not there" answers 2 "no/such/file" "$bin/elliptic_spe10" -layer no/such/file -out "$scratch" -figures "$scratch"
echo "1 2 3" > "$scratch/short.dat"
check "a file that is too short" answers 2 "3 numbers" "$bin/elliptic_spe10" -perm "$scratch/short.dat" -out "$scratch" -figures "$scratch"
check "no number" answers 2 "-seed" "$bin/icspm_random" -seed x
check "out of range" answers 2 "-seed" "$bin/icspm_random" -seed -1
check "out of range" answers 2 "-small" "$bin/icspm_random" -small 3
if [ -x "$bin/cleaning_collapse" ]; then
    check "a field without limits" answers 2 "ratio is positive" "$bin/cleaning_collapse" -mass-to-flux 0 -out "$scratch" -figures "$scratch"
    check "a sink without a size" answers 2 "must be positive" "$bin/cleaning_collapse" -sink-radius 0 -out "$scratch" -figures "$scratch"
fi

table=$scratch/icspm_uniform.csv
check "a run" answers 0 "0 differs" "$bin/icspm_uniform" -out "$scratch" -figures "$scratch"
check "columns of the result table" grep -q -x 'item,setting,quantity,published,reference,source,measured,criterion,verdict' "$table"
check "all of tables 1, 2, 3 match" test "$(grep -c '^Table [123],.*,match$' "$table")" -ge 105
check "no partial table is left" test ! -e "$table.part"
check "figure 2 has 41 particles" test "$(wc -l < "$scratch/icspm_fig2.csv")" -eq 42

check "table 1 of the elliptic paper" answers 0 "0 differs" "$bin/elliptic_slit" -out "$scratch" -figures "$scratch"

check "scoreboard" answers 0 "icspm_uniform" "$bin/scoreboard" "$table"
sed 's/,match$/,differs/' "$table" > "$scratch/wrong.csv"
check "scoreboard of a table that differs" answers 1 "differ" "$bin/scoreboard" "$scratch/wrong.csv"
mkdir "$scratch/kept"
cp "$table" "$scratch/kept/icspm_uniform.csv"
check "a long run that is kept" answers 0 "icspm_uniform .* [1-9][0-9]*/0/[0-9]*$" "$bin/scoreboard" -kept "$scratch/kept" "$table"
check "a long run made again" answers 0 ", 0 with another verdict" "$bin/scoreboard" -kept "$scratch/kept" -compare "$table"
sed '/^Table 1/s/,match$/,info/' "$table" > "$scratch/kept/icspm_uniform.csv"
check "a long run with another verdict" answers 1 "Table 1.*: match .*, kept info" "$bin/scoreboard" -kept "$scratch/kept" -compare "$table"
sed '2d' "$table" > "$scratch/kept/icspm_uniform.csv"
check "a long run with fewer rows" answers 0 "0 with another verdict.* 1 rows without" "$bin/scoreboard" -kept "$scratch/kept" -compare "$table"
check "scoreboard of no table" answers 2 "missing.csv" "$bin/scoreboard" "$scratch/missing.csv"
sed 's/,match$/,fitted/' "$table" > "$scratch/fits.csv"
check "a fit is no match" answers 0 "^ *fits  *[0-9][0-9]*  *0  *0  *0  *0  *0  *0  *0  *[1-9]" "$bin/scoreboard" "$scratch/fits.csv"
sed '3s/,,,/,,theory,/' "$table" > "$scratch/source.csv"
check "a published value has no other source" answers 2 "record 3.*another source" "$bin/scoreboard" "$scratch/source.csv"

# A row whose criterion excludes the value that it judges would be a match that says nothing.
cat > "$scratch/refused.c" << 'END'
#include "examples/common/report.h"
int main(int argc, char **argv)
{
    static report r;
    report_open(&r, "refused", argv[1]);
    report_range(&r, "item", "setting", "within", 1, 2, argc > 2 ? 1.5 : 0.5, 3);
    return report_close(&r);
}
END
check "a table of one row" "$CC" -std=c99 -I. "$scratch/refused.c" -o "$scratch/refused" -lm
check "a range with the published value" answers 0 "1 match" "$scratch/refused" "$scratch"
check "a range without it" answers 2 "value to compare with is 1, and the criterion 'in \[1.5, 3\]' excludes it" "$scratch/refused" "$scratch" without

# how far a command is: told on a terminal, and nowhere else
: > "$scratch/one.done"
watched="BUILD='$scratch' sh examples/common/progress.sh try '$scratch/*.done' one two & sleep 1.5; kill \$! 2> /dev/null; wait"
check "no progress in a pipe" test -z "$(unset CI; sh -c "$watched" 2>&1)"
if needs "progress on a terminal" script && works "progress on a terminal" script -qec true /dev/null; then
    check "progress on a terminal" sh -c 'unset CI; script -qec "$1" /dev/null | grep "try: 1 of 2 done, "' watched "$watched"
    check "no progress with CI set" sh -c 'test -z "$(CI=1 script -qec "$1" /dev/null)"' watched "$watched"
fi
finish examples
