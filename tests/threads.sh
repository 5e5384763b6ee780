#!/bin/sh
# SPDX-License-Identifier: MIT
# The drivers that take -threads write the same files with any number of them, byte for byte, but for the seconds that
# they report; a refusal is told as by one thread; without POSIX threads they are told that there are none.
. tests/check.sh
bin=$BUILD/examples

# DRIVER OPTIONS ...: with 1, 2 and 3 threads
same() {
    driver=$1
    shift
    for threads in 1 2 3; do
        to=$scratch/$driver-$threads
        mkdir -p "$to" && CI=1 "$bin/$driver" "$@" -threads $threads -out "$to" -figures "$to" > /dev/null || return
        for file in "$to"/*.csv; do grep -v -e 'time \[s\]' -e ',CPU ' "$file" > "$file.kept"; mv "$file.kept" "$file"; done
        rm -f "$to"/*.restart # which hold the seconds, too
        [ $threads = 1 ] || diff -r "$scratch/$driver-1" "$to" || return
    done
    [ -s "$scratch/$driver-1/$driver.csv" ]
}
tried=0
try() {
    [ -x "$bin/$1" ] || return # sanitizers look at some drivers only
    tried=$((tried + 1))
    check "$1 with 1, 2, 3 threads" same "$@"
}
try clustering_shaft -kernel wendland-c2-1d -remedy sequential -dref 0.01 -dt 2e-5 -tend 0.002
try clustering_dam3d -resolution 4
try fluids_plates -method sun_2019
try cleaning_orszag_tang -side 16 -end 0.05
try cleaning_collapse -particles 100 -end 0.02
try gas_sedov
[ $tried -gt 0 ] || skip "threads of the drivers" "none of them was built"

cat > "$scratch/team.c" <<'END'
#include <stdio.h>
#include "examples/common/options.h"
#include "examples/common/threads.h"
enum { COUNT = 1000 };
static int seen[COUNT];
static long mark(void *data, long first, long last)
{
    long k;
    for (k = first; k < last; k++) ((int *)data)[k]++;
    return last - first;
}
/* as a sweep that is refused from `*data` on: the number says where that was noticed last */
static long noticed = -1;
static long refused(void *data, long first, long last)
{
    const long from = *(const long *)data;
    if (last <= from) return 0;
    threads_lock();
    noticed = first < from ? from : first;
    threads_unlock();
    return -5;
}
int main(int argc, char **argv)
{
    const option_spec specs[] = {THREADS_OPTION};
    const long from = 500;
    long n, k, answer, sum = 0, wrong = 0;
    int round;
    options_parse(argc, argv, "", specs, 1);
    for (round = 0; round < 2000; round++)
        for (n = 0; n < 4; n++) wrong += threads_each(n, mark, seen) != n;
    for (n = 4; n <= COUNT; n += 83) wrong += threads_each(n, mark, seen) != n;
    for (k = 0; k < COUNT; k++) sum = sum * 31 % 1000003 + seen[k];
    answer = threads_each(COUNT, refused, (void *)&from);
    printf("%ld %ld %ld %ld\n", wrong, sum, answer, noticed);
    return 0;
}
END
team() {
    # shellcheck disable=SC2086
    $CC -std=c99 -Wall -Wextra -Wpedantic -I. $1 -o "$scratch/team" "$scratch/team.c" -lm || return
    for threads in 1 2 3 8; do "$scratch/team" -threads $threads || return; done > "$scratch/answers"
    [ "$(uniq "$scratch/answers" | wc -l)" -eq 1 ] && grep -q '^0 ' "$scratch/answers"
}
without() {
    team "" && "$scratch/team" -threads 3 2>&1 | grep -c 'one thread, not 3' | grep -q -x 1
}
check "without threads, which is said once" without
if runs '#include <pthread.h>\n'"$empty" '' "$CC" -pthread; then
    check "every number once, by any number of threads" team "-DTHREADS=1 -pthread"
    if runs "$empty" '' "$CC" -fsanitize=thread; then
        check "no race" team "-g -DTHREADS=1 -pthread -fsanitize=thread"
    else skip "races" "$why"; fi
else skip "threads" "$why"; fi
finish threads
