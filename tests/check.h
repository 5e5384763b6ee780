/* SPDX-License-Identifier: MIT */
/*
 * check.h - count checks, and print those that fail with their values.
 *
 *     CHECK(condition)
 *     CHECK_CLOSE(a, b, tolerance)       |a - b| <= tolerance
 *     CHECK_RELATIVE(a, b, tolerance)    |a - b| <= tolerance * |b|
 *     return check_report("test_name");  from main
 *
 * With -DCHECK_STOP the first that fails ends the program. A NaN fails.  One translation unit per test program: the counts are static.
 */
#ifndef CHECK_H
#define CHECK_H

#include <math.h>
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

#define CHECK(condition) check_condition((condition) ? 1 : 0, __FILE__, __LINE__, #condition)
#define CHECK_CLOSE(a, b, tolerance) \
    check_close(a, b, tolerance, __FILE__, __LINE__, #a " close to " #b)
#define CHECK_RELATIVE(a, b, tolerance) \
    check_relative(a, b, tolerance, __FILE__, __LINE__, #a " relatively close to " #b)

static inline int check_report(const char *name)
{
    printf("%s: %d passed, %d failed\n", name, check_passed, check_failed);
    return check_failed != 0;
}

#endif
