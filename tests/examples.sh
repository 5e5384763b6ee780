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
check "columns of the result table" grep -q -x 'item,setting,quantity,published,measured,criterion,verdict' "$table"
check "all of tables 1, 2, 3 match" test "$(grep -c '^Table [123],.*,match$' "$table")" -ge 105
check "no partial table is left" test ! -e "$table.part"
check "figure 2 has 41 particles" test "$(wc -l < "$scratch/icspm_fig2.csv")" -eq 42

check "table 1 of the elliptic paper" answers 0 "0 differs" "$bin/elliptic_slit" -out "$scratch" -figures "$scratch"

check "scoreboard" answers 0 "icspm_uniform" "$bin/scoreboard" "$table"
sed 's/,match$/,differs/' "$table" > "$scratch/wrong.csv"
check "scoreboard of a table that differs" answers 1 "differ" "$bin/scoreboard" "$scratch/wrong.csv"
check "scoreboard of no table" answers 2 "missing.csv" "$bin/scoreboard" "$scratch/missing.csv"
finish examples
