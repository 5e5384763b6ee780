/* SPDX-License-Identifier: MIT */
/*
 * options.h - command line of the drivers: `-name value` from a table.
 *
 *     int n = 100;
 *     const char *out = ".";
 *     const option_spec specs[] = {
 *         {"n", "particles per side", OPTION_INT, &n, 2, 4096},
 *         {"out", "directory of the results", OPTION_TEXT, &out, 0, 0},
 *     };
 *     options_parse(argc, argv, "What the driver does.", specs, 2);
 *
 * The values before the call are the defaults. From the call on, the locale of numbers is "C": what a driver
 * prints into figures and tables has decimal points.
 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "number.h"

#include <errno.h>
#include <float.h>
#include <limits.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum option_type {
    OPTION_INT,  /* int */
    OPTION_REAL, /* double, finite */
    OPTION_TEXT, /* const char *, into argv */
    OPTION_FLAG  /* int: set to 1, takes no value */
} option_type;

typedef struct option_spec {
    const char *name; /* without the dash; "h" is taken */
    const char *help;
    enum option_type type;
    void *value;
    double lowest, highest; /* of a number; no limits unless lowest < highest;
                             * one-sided with DBL_MAX or -DBL_MAX */
} option_spec;

/* The limits that apply, both included. */
static inline double option_lowest(const option_spec *spec)
{
    const double least = spec->type == OPTION_INT ? INT_MIN : -DBL_MAX;
    return spec->lowest < spec->highest && spec->lowest > least ? spec->lowest : least;
}

static inline double option_highest(const option_spec *spec)
{
    const double most = spec->type == OPTION_INT ? INT_MAX : DBL_MAX;
    return spec->lowest < spec->highest && spec->highest < most ? spec->highest : most;
}

/* Store the value that the text stands for.  Returns 0, and stores nothing, if
 * the text is not wholly a number or the number is not within the limits. */
static inline int option_set(const option_spec *spec, const char *text)
{
    errno = 0;
    if (spec->type == OPTION_INT) {
        char *end = NULL;
        const long value = strtol(text, &end, 10);
        if (end == text || *end || errno == ERANGE || value < INT_MIN || value > INT_MAX || (double)value < option_lowest(spec) ||
            (double)value > option_highest(spec))
            return 0;
        *(int *)spec->value = (int)value;
    } else if (spec->type == OPTION_REAL) {
        const char *end;
        const double value = number_of(text, &end);
        if (end == text || *end || !(value >= option_lowest(spec) && value <= option_highest(spec))) return 0; /* NaN and infinities too */
        *(double *)spec->value = value;
    } else if (spec->type == OPTION_TEXT) {
        *(const char **)spec->value = text;
    } else {
        *(int *)spec->value = 1;
    }
    return 1;
}

/* What the option accepts, e.g. "a whole number, at least 2, at most 4096". */
static inline void option_print_allowed(FILE *to, const option_spec *spec)
{
    if (spec->type == OPTION_TEXT || spec->type == OPTION_FLAG) {
        fputs(spec->type == OPTION_TEXT ? "any text" : "no value", to);
        return;
    }
    fputs(spec->type == OPTION_INT ? "a whole number" : "a finite number", to);
    const option_spec unlimited = {"", "", spec->type, NULL, 0.0, 0.0};
    char number[NUMBER_TEXT];
    if (option_lowest(spec) > option_lowest(&unlimited)) fprintf(to, ", at least %s", number_text(number, 10, option_lowest(spec)));
    if (option_highest(spec) < option_highest(&unlimited)) fprintf(to, ", at most %s", number_text(number, 10, option_highest(spec)));
}

static inline void option_print_default(FILE *to, const option_spec *spec)
{
    char number[NUMBER_TEXT];
    if (spec->type == OPTION_INT) fprintf(to, "; default %d", *(const int *)spec->value);
    else if (spec->type == OPTION_REAL) fprintf(to, "; default %s", number_text(number, 10, *(const double *)spec->value));
    else if (spec->type == OPTION_TEXT && *(const char *const *)spec->value) fprintf(to, "; default '%s'", *(const char *const *)spec->value);
}

static inline void options_usage(FILE *to, const char *program, const char *about, const option_spec *specs, int count)
{
    static const char *const placeholder[] = {" N", " X", " TEXT", ""};
    fprintf(to, "usage: %s [-name value] ...\n\n%s\n\n", program, about);
    for (int k = 0; k < count; ++k) {
        const int room = 16 - (int)strlen(specs[k].name);
        fprintf(to, "  -%s%-*s %s (", specs[k].name, room > 0 ? room : 0, placeholder[specs[k].type], specs[k].help);
        option_print_allowed(to, &specs[k]);
        option_print_default(to, &specs[k]);
        fputs(")\n", to);
    }
    fprintf(to, "  -%-16s %s\n", "h", "this text");
}

static inline const option_spec *option_find(const option_spec *specs, int count, const char *word)
{
    for (int k = 0; k < count; ++k)
        if (word[0] == '-' && strcmp(word + 1, specs[k].name) == 0) return &specs[k];
    return NULL;
}

/* Set the values, or exit: 0 after -h, 2 with a message after anything wrong. */
static inline void options_parse(int argc, char **argv, const char *about, const option_spec *specs, int count)
{
    const char *program = argc > 0 && argv[0] ? argv[0] : "driver";
    setlocale(LC_NUMERIC, "C");

    for (int k = 1; k < argc; ++k) /* first, while the values are the defaults */
        if (strcmp(argv[k], "-h") == 0 || strcmp(argv[k], "--help") == 0) {
            options_usage(stdout, program, about, specs, count);
            exit(0);
        }

    for (int k = 1; k < argc; ++k) {
        const option_spec *spec = option_find(specs, count, argv[k]);
        if (!spec) {
            fprintf(stderr, "%s: unknown option '%s'; the options are", program, argv[k]);
            for (int m = 0; m < count; ++m) fprintf(stderr, " -%s", specs[m].name);
            fprintf(stderr, " -h; see %s -h\n", program);
            exit(2);
        }
        const char *value = "";
        if (spec->type != OPTION_FLAG) value = ++k < argc ? argv[k] : NULL;
        if (!value || !option_set(spec, value)) {
            fprintf(stderr, "%s: option -%s: ", program, spec->name);
            if (value) fprintf(stderr, "'%s' is not allowed", value);
            else fputs("its value is missing", stderr);
            fputs("; expected ", stderr);
            option_print_allowed(stderr, spec);
            fprintf(stderr, "; see %s -h\n", program);
            exit(2);
        }
    }
}

#endif
