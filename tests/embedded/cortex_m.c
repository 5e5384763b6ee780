/* SPDX-License-Identifier: MIT */
/* Start-up of a Cortex-M: vectors, data, bss, the floating-point unit, a painted stack (so that its deepest use can be read off), main. */
#include <stdint.h>

extern uint32_t board_data_load[], board_data[], board_data_end[], board_bss[], board_bss_end[], board_stack_low[], board_stack_top[];
extern int main(void);
void board_reset(void);
void board_fault(void);

/* a fault ends the emulation with a status that is not 0 */
void board_fault(void)
{
    const uint32_t reason[2] = {0x20023, 1}; /* ADP_Stopped_RunTimeErrorUnknown */
    register uint32_t r0 __asm__("r0") = 0x20;
    register const uint32_t *r1 __asm__("r1") = reason;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    for (;;) {}
}

void board_reset(void)
{
    const volatile uint32_t *from = board_data_load;
    volatile uint32_t *to; /* volatile: no memset, no memcpy before there is memory */
    uint32_t here;
#if defined(__ARM_FP)
    *(volatile uint32_t *)0xe000ed88u |= 0xfu << 20; /* CPACR: full access to coprocessors 10 and 11 */
    __asm__ volatile("dsb\n isb");
#endif
    for (to = board_data; to < board_data_end; to++) *to = *from++;
    for (to = board_bss; to < board_bss_end; to++) *to = 0;
    for (to = board_stack_low; (uintptr_t)to < (uintptr_t)&here - 64; to++) *to = 0x5bd1e995u;
    main();
    for (;;) {}
}

typedef void (*board_vector)(void);
__attribute__((section(".vectors"), used)) static const struct {
    uint32_t *stack;
    board_vector reset, nmi, hard, memory, bus, usage;
} board_vectors = {board_stack_top, board_reset, board_fault, board_fault, board_fault, board_fault, board_fault};
