/* SPDX-License-Identifier: MIT
 *
 * number.h - numbers in files and on command lines, with a decimal point in every locale. In a program that
 * has called setlocale (most programs with a window do), printf may write 1.5 as "1,5", and strtod may read
 * "1.5" as 1.
 *
 *     char text[NUMBER_TEXT];
 *     fprintf(file, "%s\n", number_text(text, 9, 1.5));
 *     x = number_of("1.5", &end);
 */
#ifndef NUMBER_H
#define NUMBER_H

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER_TEXT = 32, NUMBER_LONGEST = 512 };

/* What "%.*g" writes in the locale "C", with at most 17 digits; "nan" for any NaN, because its sign means
   nothing (that of tcc's NAN is set). Returns text. */
static inline const char *number_text(char text[NUMBER_TEXT], int digits, double value)
{
    const char *const point = localeconv()->decimal_point;
    char *at;
    if (isnan(value)) return strcpy(text, "nan");
    snprintf(text, NUMBER_TEXT, "%.*g", digits, value);
    at = strstr(text, point);
    if (at) {
        *at = '.';
        memmove(at + 1, at + strlen(point), strlen(at + strlen(point)) + 1);
    }
    return text;
}

/* The decimal number at the beginning of the text, as strtod reads it in the locale "C"; *end is what follows
   it. Where there is none, *end is text: also for spaces, "inf", "nan", and NUMBER_LONGEST characters. */
static inline double number_of(const char *text, const char **end)
{
    const char *const point = localeconv()->decimal_point;
    const size_t length = strspn(text, "0123456789+-.eE"), size = strlen(point);
    const char *const at = (const char *)memchr(text, '.', length);
    const size_t before = at ? (size_t)(at - text) : length;
    char copy[NUMBER_LONGEST + NUMBER_TEXT], *stop;
    double value;
    size_t used;
    *end = text;
    if (length >= NUMBER_LONGEST || size > NUMBER_TEXT) return 0;
    memcpy(copy, text, length);
    copy[length] = '\0';
    if (before < length) {
        memcpy(copy + before, point, size);
        memcpy(copy + before + size, text + before + 1, length - before - 1);
        copy[length + size - 1] = '\0';
    }
    value = strtod(copy, &stop);
    used = (size_t)(stop - copy);
    *end = text + (used > before ? used + 1 - size : used);
    return value;
}

#endif
