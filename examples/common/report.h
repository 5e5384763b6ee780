/* SPDX-License-Identifier: MIT */
/*
 * report.h - the table of published against measured values.
 *
 * A driver opens one report, adds one row for every value it compares and
 * returns `report_close(&r) ? 1 : 0` from main.  Each row is printed as a
 * line of a table and written to <out_dir>/<name>.csv, whose columns are
 *
 *     item,setting,quantity,published,reference,source,measured,criterion,verdict
 *
 * quoted as in RFC 4180 with lines ended by "\n".  `published` holds what the
 * paper prints and nothing else.  Any other value to compare with stands under
 * `reference`, and `source` says whose it is:
 *
 *     theory          it follows from a formula, or from an identity
 *     other authors   another publication prints it
 *     regression      this toolkit, or an earlier trial of it, had it before
 *
 * A row with neither is judged by a limit that the driver has set itself.  The
 * verdicts:
 *
 *     match           the measured value meets the criterion
 *     consistent      a published random outcome lies in our own spread
 *     fitted          as match, with a parameter that was fitted to what is
 *                     published: the agreement proves less
 *     differs         the criterion fails: the only verdict that is a failure
 *     not-reproduced  known not to agree; the criterion column says why
 *     info            measured only, nothing to compare with
 *
 * A range must contain the value that it is said to judge: a row that would
 * call a measured value a match and the published one not ends the program
 * with the exit status 2.
 *
 * A run cut short never leaves half a table under the final name (part_file.h).
 *
 * report_read reads such a file back, one record at a time.
 */
#ifndef REPORT_H
#define REPORT_H

#include "number.h"
#include "part_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef enum report_verdict {
    REPORT_MATCH,
    REPORT_CONSISTENT,
    REPORT_FITTED,
    REPORT_DIFFERS,
    REPORT_NOT_REPRODUCED,
    REPORT_INFO,
    REPORT_VERDICTS /* their number */
} report_verdict;

/* Where the value comes from that a row compares with. */
typedef enum report_source {
    REPORT_PAPER, /* what a row has unless report_beside says otherwise */
    REPORT_THEORY,
    REPORT_OTHERS,
    REPORT_REGRESSION,
    REPORT_SOURCES /* their number */
} report_source;

enum {
    REPORT_QUANTITY = 2,
    REPORT_PUBLISHED,
    REPORT_REFERENCE,
    REPORT_SOURCE,
    REPORT_MEASURED,
    REPORT_JUDGED_BY,
    REPORT_VERDICT,
    REPORT_COLUMNS
};
enum { REPORT_CRITERION = 96, REPORT_DIGITS = 9 };

typedef struct report {
    part_file file;
    FILE *screen; /* where the readable table goes: stdout */
    const char *name;
    time_t wall; /* at report_open */
    clock_t cpu; /* at report_open */
    int headed;  /* the column names are on the screen */
    report_source source; /* of the next row */
    int fitted;           /* the next row has a fitted parameter */
    int count[REPORT_VERDICTS];
} report;

/* CPU seconds of earlier pieces of the run, which restarts bring along */
static double report_cpu_before;

static inline const char *report_column_name(int column)
{
    static const char *const name[REPORT_COLUMNS] = {"item",   "setting",  "quantity",  "published", "reference",
                                                     "source", "measured", "criterion", "verdict"};
    return name[column];
}

static inline const char *report_verdict_name(int verdict)
{
    static const char *const name[REPORT_VERDICTS] = {"match", "consistent", "fitted", "differs", "not-reproduced", "info"};
    return name[verdict];
}

/* As the source column shows it: "" for the paper, whose values have a column of their own. */
static inline const char *report_source_name(int source)
{
    static const char *const name[REPORT_SOURCES] = {"", "theory", "other authors", "regression"};
    return name[source];
}

/* ---- writing ----------------------------------------------------------- */

/* Write one CSV field: the text, then "; " and the reason where there is one. */
static inline void report_csv_field(FILE *csv, const char *text, const char *reason)
{
    const char *piece[3];
    piece[0] = text;
    piece[1] = *text && *reason ? "; " : "";
    piece[2] = reason;

    const int quoted = strpbrk(text, ",\"\r\n") != NULL || strpbrk(reason, ",\"\r\n") != NULL;
    if (quoted) putc('"', csv);
    for (int k = 0; k < 3; ++k)
        for (const char *c = piece[k]; *c; ++c) {
            if (*c == '"') putc('"', csv);
            putc(*c, csv);
        }
    if (quoted) putc('"', csv);
}

/* One line of the readable table.  Text wider than its column is never cut:
 * it moves what follows to the right. */
static inline void report_screen_line(FILE *screen, const char *mark, const char *const *field, const char *reason)
{
    fprintf(screen, "%-3s%-12s %-32s %-20s %-16s %-12s %-10s ", mark, field[0], field[1], field[REPORT_QUANTITY],
            field[REPORT_PUBLISHED], field[REPORT_REFERENCE], field[REPORT_SOURCE]);
    fprintf(screen, "%-16s %-24s %s", field[REPORT_MEASURED], field[REPORT_JUDGED_BY], field[REPORT_VERDICT]);
    if (*reason) fprintf(screen, " (%s)", reason);
    putc('\n', screen);
}

static inline void report_screen_heading(report *r)
{
    const char *field[REPORT_COLUMNS];
    for (int k = 0; k < REPORT_COLUMNS; ++k) field[k] = report_column_name(k);
    report_screen_line(r->screen, "", field, "");
    r->headed = 1;
}

/* Of the next row: its value to compare with is not the paper's, but of this source.
 *
 *     report_absolute(report_beside(r, REPORT_THEORY), ..., 0.5, measured, 1e-3);
 */
static inline report *report_beside(report *r, report_source source)
{
    r->source = source;
    return r;
}

/* Of the next row: a parameter of it was fitted to what is published (say which in its
 * setting).  Where it meets its criterion it is 'fitted' and never a match. */
static inline report *report_with_fit(report *r)
{
    r->fitted = 1;
    return r;
}

/* Every row passes here.  Absent texts may be NULL.  against: the value to compare with,
 * published or (report_beside) another. */
static inline void report_row(report *r, const char *item, const char *setting, const char *quantity, const char *against, const char *measured,
                              const char *criterion, const char *reason, report_verdict verdict)
{
    const char *field[REPORT_COLUMNS] = {NULL};
    if (r->fitted && verdict == REPORT_MATCH) verdict = REPORT_FITTED;
    field[0] = item;
    field[1] = setting;
    field[REPORT_QUANTITY] = quantity;
    field[r->source == REPORT_PAPER ? REPORT_PUBLISHED : REPORT_REFERENCE] = against;
    field[REPORT_SOURCE] = report_source_name((int)r->source);
    field[REPORT_MEASURED] = measured;
    field[REPORT_JUDGED_BY] = criterion;
    field[REPORT_VERDICT] = report_verdict_name((int)verdict);
    r->source = REPORT_PAPER;
    r->fitted = 0;
    for (int k = 0; k < REPORT_COLUMNS; ++k)
        if (!field[k]) field[k] = "";
    if (!reason) reason = "";

    for (int k = 0; k < REPORT_COLUMNS; ++k) {
        report_csv_field(r->file.to, field[k], k == REPORT_JUDGED_BY ? reason : "");
        putc(k + 1 < REPORT_COLUMNS ? ',' : '\n', r->file.to);
    }
    if (!r->headed) report_screen_heading(r);
    report_screen_line(r->screen, verdict == REPORT_DIFFERS ? "!!" : "", field, reason);
    fflush(r->screen); /* rows of a long run should be seen as they come */
    ++r->count[verdict];
}

/* A number as the CSV shows it; NAN for an absent value to compare with is "". */
static inline const char *report_against(char text[NUMBER_TEXT], double value)
{
    return isnan(value) ? "" : number_text(text, REPORT_DIGITS, value);
}

static inline void report_number_row(report *r, const char *item, const char *setting, const char *quantity, double against, double measured,
                                     const char *criterion, const char *reason, report_verdict verdict)
{
    char against_text[NUMBER_TEXT], measured_text[NUMBER_TEXT];
    report_row(r, item, setting, quantity, report_against(against_text, against), number_text(measured_text, REPORT_DIGITS, measured), criterion, reason, verdict);
}

static inline void report_fail(const report *r, const char *what, const char *path, const char *advice)
{
    fflush(stdout);
    fprintf(stderr, "%s: cannot %s '%s': %s; %s\n", r->name, what, path, errno ? strerror(errno) : "unknown cause", advice);
    exit(2);
}

/* Start <out_dir>/<name>.csv.  The name must outlive the report. */
static inline void report_open(report *r, const char *name, const char *out_dir)
{
    memset(r, 0, sizeof *r);
    r->name = name;
    r->screen = stdout;
    r->wall = time(NULL);
    r->cpu = clock();

    if (!part_file_open(&r->file, out_dir, name, "csv"))
        report_fail(r, "write", r->file.part, "create the output directory, or name one that exists and can be written");
    for (int k = 0; k < REPORT_COLUMNS; ++k) fprintf(r->file.to, "%s%c", report_column_name(k), k + 1 < REPORT_COLUMNS ? ',' : '\n');
}

/* A heading, on the screen only. */
static inline void report_section(report *r, const char *title)
{
    fprintf(r->screen, "\n== %s ==\n", title);
    report_screen_heading(r);
}

/* |measured/against - 1| <= tolerance.  For a value of 0 use report_absolute. */
static inline void report_relative(report *r, const char *item, const char *setting, const char *quantity, double against, double measured, double tolerance)
{
    char criterion[REPORT_CRITERION], number[NUMBER_TEXT];
    snprintf(criterion, sizeof criterion, "rel <= %s", number_text(number, 6, tolerance));
    const int holds = fabs(measured / against - 1.0) <= tolerance;
    report_number_row(r, item, setting, quantity, against, measured, criterion, NULL, holds ? REPORT_MATCH : REPORT_DIFFERS);
}

/* |measured - against| <= tolerance. */
static inline void report_absolute(report *r, const char *item, const char *setting, const char *quantity, double against, double measured, double tolerance)
{
    char criterion[REPORT_CRITERION], number[NUMBER_TEXT];
    snprintf(criterion, sizeof criterion, "abs <= %s", number_text(number, 6, tolerance));
    const int holds = fabs(measured - against) <= tolerance;
    report_number_row(r, item, setting, quantity, against, measured, criterion, NULL, holds ? REPORT_MATCH : REPORT_DIFFERS);
}

/* 1/factor <= measured/against <= factor, for a factor above 1. */
static inline void report_factor(report *r, const char *item, const char *setting, const char *quantity, double against, double measured, double factor)
{
    char criterion[REPORT_CRITERION], number[NUMBER_TEXT];
    snprintf(criterion, sizeof criterion, "within a factor of %s", number_text(number, 6, factor));
    const int holds = measured / against <= factor && against / measured <= factor;
    report_number_row(r, item, setting, quantity, against, measured, criterion, NULL, holds ? REPORT_MATCH : REPORT_DIFFERS);
}

/* lo <= measured <= hi.  The value that is compared with (NAN: none) must be in there, too:
 * a range that accepts what is measured and not what is published is a fault of the driver. */
static inline void report_range(report *r, const char *item, const char *setting, const char *quantity, double against, double measured, double lo, double hi)
{
    char criterion[REPORT_CRITERION], from[NUMBER_TEXT], to[NUMBER_TEXT], value[NUMBER_TEXT];
    snprintf(criterion, sizeof criterion, "in [%s, %s]", number_text(from, 6, lo), number_text(to, 6, hi));
    if (against < lo || against > hi) {
        fflush(stdout);
        fprintf(stderr, "%s: %s, %s, %s: the value to compare with is %s, and the criterion '%s' excludes it: a match would say nothing\n", r->name, item,
                setting, quantity, number_text(value, REPORT_DIGITS, against), criterion);
        exit(2);
    }
    const int holds = lo <= measured && measured <= hi;
    report_number_row(r, item, setting, quantity, against, measured, criterion, NULL, holds ? REPORT_MATCH : REPORT_DIFFERS);
}

/* A published random outcome against our own spread: lo <= published <= hi is
 * consistent.  The caller says what a value outside means, and why; with many
 * values some are outside by chance, so one alone need not be a failure. */
static inline void report_band(report *r, const char *item, const char *setting, const char *quantity, double published, double measured_median, double lo,
                               double hi, report_verdict outside_verdict, const char *outside_reason)
{
    char criterion[REPORT_CRITERION], from[NUMBER_TEXT], to[NUMBER_TEXT];
    snprintf(criterion, sizeof criterion, "published in [%s, %s]", number_text(from, 6, lo), number_text(to, 6, hi));
    const int inside = lo <= published && published <= hi;
    report_number_row(r, item, setting, quantity, published, measured_median, criterion, inside ? NULL : outside_reason,
                      inside ? REPORT_CONSISTENT : outside_verdict);
}

/* A published statement in words. */
static inline void report_claim(report *r, const char *item, const char *setting, const char *quantity, const char *published_text, const char *measured_text,
                                const char *criterion_text, int holds)
{
    report_row(r, item, setting, quantity, published_text, measured_text, criterion_text, NULL, holds ? REPORT_MATCH : REPORT_DIFFERS);
}

/* A published statement in words that does not hold, and why. */
static inline void report_claim_fails(report *r, const char *item, const char *setting, const char *quantity, const char *published_text,
                                      const char *measured_text, const char *reason)
{
    report_row(r, item, setting, quantity, published_text, measured_text, NULL, reason, REPORT_NOT_REPRODUCED);
}

/* A published statement of which it is known whether it holds here (expected), and if not,
 * why: either other outcome differs, so that the row can fail whatever is expected. */
static inline void report_claim_known(report *r, const char *item, const char *setting, const char *quantity, const char *published_text,
                                      const char *measured_text, const char *criterion_text, int holds, int expected, const char *reason)
{
    if (holds && !expected)
        report_row(r, item, setting, quantity, published_text, measured_text, "known not to hold, but it does", NULL, REPORT_DIFFERS);
    else if (expected) report_claim(r, item, setting, quantity, published_text, measured_text, criterion_text, holds);
    else report_claim_fails(r, item, setting, quantity, published_text, measured_text, reason);
}

/* A published value that is known not to come out, and why. */
static inline void report_not_reproduced(report *r, const char *item, const char *setting, const char *quantity, double published, double measured,
                                         const char *reason)
{
    report_number_row(r, item, setting, quantity, published, measured, NULL, reason, REPORT_NOT_REPRODUCED);
}

/* A measured value with nothing to compare. */
static inline void report_info(report *r, const char *item, const char *setting, const char *quantity, double measured)
{
    char text[NUMBER_TEXT];
    report_row(r, item, setting, quantity, NULL, number_text(text, REPORT_DIGITS, measured), NULL, NULL, REPORT_INFO);
}

/* Add the run's times, put the CSV under its final name, print a summary and
 * return the number of rows that differ.  A write that failed exits with 2. */
static inline int report_close(report *r)
{
    const double wall = difftime(time(NULL), r->wall);
    report_info(r, "run", "", "CPU time [s]", report_cpu_before + (double)(clock() - r->cpu) / CLOCKS_PER_SEC);
    report_info(r, "run", "", "wall time [s]", wall);

    errno = 0;
    if (!part_file_close(&r->file)) report_fail(r, "write", r->file.path, "is the disk full? What there is of it is in the .part file beside it");

    fprintf(r->screen, "\n%s:", r->name);
    for (int k = 0; k < REPORT_VERDICTS; ++k) fprintf(r->screen, " %d %s,", r->count[k], report_verdict_name(k));
    fprintf(r->screen, " %.0f s -> %s\n", wall, r->file.path);
    fflush(r->screen);
    return r->count[REPORT_DIFFERS];
}

/* ---- reading ----------------------------------------------------------- */

typedef struct report_record {
    const char *field[REPORT_COLUMNS]; /* valid until the next report_read */
    char *text;                        /* the fields, each ended by '\0' */
    size_t used, size;
} report_record;

/* Append one character.  Returns 0 when there is no memory. */
static inline int report_record_put(report_record *record, int c)
{
    if (record->used == record->size) {
        const size_t size = 2 * record->size + 256;
        char *text = size > record->size ? realloc(record->text, size) : NULL;
        if (!text) return 0;
        record->text = text;
        record->size = size;
    }
    record->text[record->used++] = (char)c;
    return 1;
}

/* Read one field whose first character is c.  Returns the character after it:
 * ',', '\r' or '\n', and '\0' for whatever should not be there. */
static inline int report_read_field(FILE *csv, report_record *record, int c)
{
    if (c == '"') {
        for (c = getc(csv); c != EOF && c != '\0'; c = getc(csv)) {
            if (c == '"' && (c = getc(csv)) != '"') break;
            if (!report_record_put(record, c)) return '\0';
        }
    } else {
        for (; c != EOF && !strchr(",\"\r\n", c); c = getc(csv)) /* finds '\0' too */
            if (!report_record_put(record, c)) return '\0';
    }
    if (!report_record_put(record, '\0')) return '\0';
    return c == ',' || c == '\r' || c == '\n' ? c : '\0';
}

/* Read the next record into a struct that starts as all zeros; free(record.text)
 * at the end.  Returns 1, 0 at the end of the file, or -1 when the record is
 * malformed: not REPORT_COLUMNS fields, quoting that RFC 4180 does not allow, a
 * missing last newline (a file cut short) or a read error. */
static inline int report_read(FILE *csv, report_record *record)
{
    size_t start[REPORT_COLUMNS];
    int columns = 0, c = getc(csv);
    if (c == EOF) return ferror(csv) ? -1 : 0;

    record->used = 0;
    for (;;) {
        if (columns == REPORT_COLUMNS) return -1;
        start[columns++] = record->used;
        const int after = report_read_field(csv, record, c);
        if (after == '\n' || (after == '\r' && getc(csv) == '\n')) break;
        if (after != ',') return -1;
        c = getc(csv);
    }
    if (columns != REPORT_COLUMNS) return -1;
    for (int k = 0; k < REPORT_COLUMNS; ++k) record->field[k] = record->text + start[k];
    return 1;
}

#endif
