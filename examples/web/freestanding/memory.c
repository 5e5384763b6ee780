/* SPDX-License-Identifier: MIT
 *
 * memory.c - what a compiler calls by itself, where there is no C library.
 */
#include <stddef.h>

void *memset(void *to, int value, size_t n);
void *memcpy(void *to, const void *from, size_t n);

void *memset(void *to, int value, size_t n)
{
    volatile unsigned char *byte = (volatile unsigned char *)to; /* volatile: else it would call itself */
    while (n--) *byte++ = (unsigned char)value;
    return to;
}
void *memcpy(void *to, const void *from, size_t n)
{
    volatile unsigned char *byte = (volatile unsigned char *)to;
    const unsigned char *source = (const unsigned char *)from;
    while (n--) *byte++ = *source++;
    return to;
}
