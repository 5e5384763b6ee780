/* SPDX-License-Identifier: MIT */
/*
 * board.h - how a program without an operating system says something, and ends.
 *
 *     board_start();            first thing in main
 *     board_text("text");
 *     return board_end(status); last thing in main
 *     BOARD_FLASH               of constant tables that would not fit into RAM
 *
 * Cortex-M and RISC-V: semihosting, answered by QEMU (start-up of Cortex-M in cortex_m.c, of RISC-V in picolibc). AVR: its serial port, shown by simavr.
 * Elsewhere: standard output.
 */
#ifndef BOARD_H
#define BOARD_H

#if defined(__AVR__)

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
#define BOARD_FLASH __flash
static inline void board_start(void)
{
    UBRR0 = 0;
    UCSR0B = 1 << TXEN0;
}
static inline void board_text(const char *text)
{
    for (; *text; text++) {
        while (!(UCSR0A & 1 << UDRE0)) {}
        UDR0 = (unsigned char)*text;
    }
}
/* simavr ends when the processor sleeps for ever, with status 0 whatever the program found: the text has to say it */
static inline int board_end(int status)
{
    while (!(UCSR0A & 1 << UDRE0)) {}
    cli();
    sleep_enable();
    sleep_cpu();
    return status;
}

#elif defined(__thumb__) && !defined(__linux__)

#include <stdint.h>
#define BOARD_FLASH
static inline intptr_t board_semihosting(int operation, const void *argument)
{
    register intptr_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}
extern uint32_t board_stack_low[], board_stack_top[]; /* of the linker script; painted by the start-up */
static inline void board_start(void) {}
static inline void board_text(const char *text) { board_semihosting(0x04, text); } /* SYS_WRITE0 */
/* deepest use of the stack, in bytes */
#define BOARD_STACK 1
static inline long board_stack(void)
{
    const uint32_t *p = board_stack_low;
    while (p < board_stack_top && *p == 0x5bd1e995u) p++;
    return (long)((board_stack_top - p) * 4);
}
static inline int board_end(int status)
{
    const intptr_t reason[2] = {0x20026, status}; /* ADP_Stopped_ApplicationExit */
    board_semihosting(0x20, reason);              /* SYS_EXIT_EXTENDED */
    return status;
}

#else

#include <stdio.h>
#define BOARD_FLASH
static inline void board_start(void) {}
static inline void board_text(const char *text) { fputs(text, stdout); }
static inline int board_end(int status) { return status; }

#endif
#endif
