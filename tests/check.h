/* SPDX-License-Identifier: MIT */
/*
 * check.h - count checks, and print those that fail with their values.
 *
 *     CHECK(condition)
 *     CHECK_CLOSE(a, b, tolerance)       |a - b| <= tolerance
 *     CHECK_RELATIVE(a, b, tolerance)    |a - b| <= tolerance * |b|
 * of a particle, in words: "gradient along x at particle 12: 1.02, expected 1, off by 0.02, allowed 1e-12"
 *     CHECK_NEAR(what, i, value, expected, allowed)        |value - expected| <= allowed
 *     CHECK_NEAR_RELATIVE(what, i, value, expected, tolerance)   |value - expected| <= tolerance * |expected|
 *     CHECK_AT(what, i, condition)                         the condition stands behind the words
 *     CHECK_SAME(what, i, value, expected)                 whole numbers: a status, a count
 * of all particles: "acceleration in 2D: off by 0.02 at most, allowed 1e-12"
 *     CHECK_WORST(what, off, allowed)                      |off| <= allowed
 * what: one string, or check_words("gradient along %c in %dD", 'x', dim)
 *     return check_report("test_name");  from main
 *
 * With -DCHECK_STOP the first that fails ends the program. A NaN fails.  One translation unit per test program: the counts are static.
 */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static int check_passed, check_failed;

static inline int check_count(int holds)
{
    if (holds)
        ++check_passed;
    else
        ++check_failed;
#ifdef CHECK_STOP
    if (!holds) exit(1);
#endif
    return holds;
}

static inline void check_condition(int holds, const char *file, int line, const char *text)
{
    if (!check_count(holds))
        fprintf(stderr, "%s:%d: failed: %s\n", file, line, text);
}

static inline void check_close(double a, double b, double allowed, const char *file, int line,
                               const char *text)
{
    const double difference = fabs(a - b);
    if (!check_count(difference <= allowed))
        fprintf(stderr, "%s:%d: failed: %s: %.17g against %.17g, off by %.3g, allowed %.3g\n", file,
                line, text, a, b, difference, allowed);
}

static inline void check_relative(double a, double b, double tolerance, const char *file, int line,
                                  const char *text)
{
    check_close(a, b, tolerance * fabs(b), file, line, text);
}

/* Words for a message, with numbers in them; they last until eight more are made. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
static inline const char *check_words(const char *format, ...)
{
    static char text[8][160];
    static int next;
    char *const into = text[next++ % 8];
    va_list values;
    va_start(values, format);
    vsnprintf(into, sizeof text[0], format, values);
    va_end(values);
    return into;
}
static inline void check_near(const char *what, long i, double value, double expected, double allowed,
                              const char *file, int line)
{
    const double off = fabs(value - expected);
    if (!check_count(off <= allowed))
        fprintf(stderr,
                "%s:%d: failed: %s at particle %ld: %.17g, expected %.17g, off by %.3g, allowed %.3g\n", file,
                line, what, i, value, expected, off, allowed);
}
static inline void check_at(const char *what, long i, int holds, const char *file, int line, const char *text)
{
    if (!check_count(holds))
        fprintf(stderr, "%s:%d: failed: %s at particle %ld: %s\n", file, line, what, i, text);
}
static inline void check_same(const char *what, long i, long value, long expected, const char *file, int line)
{
    if (!check_count(value == expected))
        fprintf(stderr, "%s:%d: failed: %s at particle %ld: %ld, expected %ld\n", file, line, what, i, value,
                expected);
}

static inline void check_worst(const char *what, double off, double allowed, const char *file, int line)
{
    if (!check_count(fabs(off) <= allowed))
        fprintf(stderr, "%s:%d: failed: %s: off by %.3g at most, allowed %.3g\n", file, line, what, fabs(off),
                allowed);
}

#define CHECK_WORST(what, off, allowed) check_worst(what, (double)(off), allowed, __FILE__, __LINE__)
#define CHECK_NEAR_RELATIVE(what, i, value, expected, tolerance) \
    check_near(what, (long)(i), (double)(value), (double)(expected), (tolerance)*fabs((double)(expected)), \
               __FILE__, __LINE__)
#define CHECK_NEAR(what, i, value, expected, allowed) \
    check_near(what, (long)(i), (double)(value), (double)(expected), allowed, __FILE__, __LINE__)
#define CHECK_AT(what, i, condition) \
    check_at(what, (long)(i), (condition) ? 1 : 0, __FILE__, __LINE__, #condition)
#define CHECK_SAME(what, i, value, expected) \
    check_same(what, (long)(i), (long)(value), (long)(expected), __FILE__, __LINE__)
#define CHECK(condition) check_condition((condition) ? 1 : 0, __FILE__, __LINE__, #condition)
#define CHECK_CLOSE(a, b, tolerance) check_close(a, b, tolerance, __FILE__, __LINE__, #a " close to " #b)
#define CHECK_RELATIVE(a, b, tolerance) \
    check_relative(a, b, tolerance, __FILE__, __LINE__, #a " relatively close to " #b)

static inline int check_report(const char *name)
{
    printf("%s: %d passed, %d failed\n", name, check_passed, check_failed);
    return check_failed != 0;
}

#endif
