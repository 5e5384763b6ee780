#!/bin/sh
# SPDX-License-Identifier: MIT
# The self-check (selfcheck.c) on machines without an operating system and on other processors, in emulators: what it finds there, what it takes of their memory.
#     tests/embedded/embedded.sh          from the repository root; runs what is installed and says what it skipped
# What is installed counts only if a trivial program of it runs in the emulator.
# Bare-metal Cortex-M (QEMU), RISC-V (picolibc, QEMU), AVR (simavr; kernels alone), and AArch64, RISC-V and s390x (big-endian) under Linux (QEMU).
. tests/check.sh
here=tests/embedded
warn="-Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion -Wstrict-prototypes -Wmissing-prototypes -Wundef -Werror -I. -I$scratch"
rows=$scratch/rows
: > "$rows"
awk -f $here/known.awk tests/known/kernels.csv > "$scratch/known_answers.h" || exit 2

alive='#include "board.h"\nint main(void) { board_start(); board_text("alive"); return board_end(0); }'

# target NAME PREFIX 'COMPILER FLAGS' 'EMULATOR'... where PREFIX names the tools: builds, runs, weighs. A NAME that ends in -linux stands on an operating system: not weighed.
target() {
    name=$1 prefix=$2 program=$scratch/$1.elf output=$scratch/$1.out
    usable "$name" "$alive" "$4" "$prefix-gcc $warn -I$here $3" -lm || return
    rm -f "$program"
    # shellcheck disable=SC2086
    check "$name compiles" $prefix-gcc $warn $3 $here/selfcheck.c -o "$program" -lm
    [ -f "$program" ] || return
    sh -c "timeout 240 $4 '$program'" 2>&1 < /dev/null | sed 's/\x1b\[[0-9]*m//g; s/\.*$//' > "$output" # without the colours and dots of simavr
    check "$name: the self-check" grep -q '^selfcheck: [0-9][0-9]* passed, 0 failed$' "$output"
    worst=$(sed -n 's/.*known answer.*: \([0-9]*\).*/\1/p' "$output") counts=$(sed -n 's/^selfcheck: //p' "$output")
    case $name in *-linux) sizes="- - - - -" ;; *)
        check "$name: no heap" sh -c "$prefix-nm '$program' > '$scratch/names' && ! grep -wE '_?(malloc|sbrk)(_r)?' '$scratch/names'"
        table=$($prefix-nm -S "$program" | awk '$4 == "answers" || $4 == "facts" { print "0x" $2 }' | while read -r size; do echo $((size)); done | awk '{ s += $1 } END { print s }')
        sizes="$($prefix-size "$program" | awk -v table="$table" 'NR == 2 { print $1 - table, table, $2, $3 }') $(sed -n 's/^stack: //p' "$output")" ;;
    esac
    # shellcheck disable=SC2086
    set -- $sizes
    printf '%-20s %8s %8s %6s %7s %6s %9s   %s\n' "$name" "$1" "$2" "$3" "$4" "${5:--}" "$(awk "BEGIN { printf \"%.2f\", $worst / 1000 }")" "$counts" >> "$rows"
}

if needs "Cortex-M" arm-none-eabi-gcc qemu-system-arm; then
    cortex() { # NAME BOARD RAM FLAGS
        target "$1" arm-none-eabi "-std=c99 -Wpedantic -Os -DSPH_SINGLE=1 -mthumb $4 -ffunction-sections -fdata-sections -nostartfiles --specs=nosys.specs -T $here/cortex_m.ld
            -Wl,--gc-sections,--defsym=board_ram=$3 $here/cortex_m.c" "qemu-system-arm -M $2 -nographic -semihosting-config enable=on,target=native -kernel"
        # a stack that is used up to its end may have run over what lies below it
        ! [ -s "$scratch/$1.elf" ] || check "$1: the stack fits" test "$(sed -n 's/^stack: //p' "$scratch/$1.out")" -lt "$(arm-none-eabi-size "$scratch/$1.elf" | awk -v ram="$3" 'NR == 2 { print ram - $2 - $3 }')"
    }
    cortex cortex-m4f mps2-an386 65536 "-mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16"
    cortex cortex-m7 mps2-an500 65536 "-mcpu=cortex-m7 -mfloat-abi=hard -mfpu=fpv5-d16"
    # 16 KiB of RAM: a shorter type of index; an int is no int16_t, and conversions in between are meant
    cortex cortex-m0 microbit 16384 "-mcpu=cortex-m0 -mfloat-abi=soft -DSPH_INDEX=int16_t -Wno-conversion"
fi
if needs "RISC-V without an operating system" riscv64-unknown-elf-gcc qemu-system-riscv64; then
    memory=-Wl,--defsym=__flash=0x80000000,--defsym=__flash_size=4M,--defsym=__ram=0x80400000,--defsym=__ram_size=4M,--defsym=__stack_size=64k
    target riscv64 riscv64-unknown-elf "-std=c99 -Wpedantic -Os --specs=picolibc.specs --oslib=semihost --crt0=hosted -march=rv64imafdc -mabi=lp64d -mcmodel=medany
        -ffunction-sections -fdata-sections $memory" "qemu-system-riscv64 -M virt -bios none -nographic -semihosting-config enable=on,target=native -kernel"
fi
if needs "AVR" avr-gcc simavr; then
    # int has 16 bits, double is float, and avr-libc's fabsf is fabs
    target avr avr "-std=gnu99 -Os -Wno-double-promotion -mmcu=atmega1284p -DSELFCHECK_KERNELS_ONLY=1 -ffunction-sections -fdata-sections -Wl,--gc-sections" "simavr -m atmega1284p -f 16000000"
fi
for machine in aarch64 riscv64 s390x; do
    if needs "$machine under Linux" $machine-linux-gnu-gcc qemu-$machine; then
        for single in 0 1; do
            [ $single = 1 ] && precision=float || precision=double
            # on s390x C99 computes float in double: those conversions are the compiler's own
            target $machine-$precision-linux $machine-linux-gnu "-std=c99 -Wpedantic -Wno-double-promotion -O2 -static -DSPH_SINGLE=$single" "qemu-$machine"
        done
    fi
done

if [ -s "$rows" ]; then
    echo "target                   code  answers   data     bss  stack round-off   self-check"
    cat "$rows"
    echo "Bytes. code: the program with the toolkit and what it takes of libm; answers: the table of known answers, in flash; RAM: data + bss + stack, no heap; stack: deepest use."
    echo "The program: every kernel and, but on AVR, a search among 132 particles, a corrected gradient, a dam break. round-off: farthest from a known answer, in units of it."
fi
finish embedded
