/* SPDX-License-Identifier: MIT */
/*
 * scoreboard FILE.csv ... - count the verdicts in the tables of report.h.
 *
 * Prints one line per driver and a total.  A match counts under what it was
 * compared with: the paper, theory, other authors, an earlier value of our own
 * (regression), or nothing but a limit that the driver has set (limit).
 * Exits with 0, with 1 if any value differs, with 2 if a file cannot be read or
 * is malformed.
 */
#include "report.h"

typedef struct score {
    int published; /* rows with a published value */
    int verdict[REPORT_VERDICTS];
    int match[REPORT_SOURCES + 1]; /* matches by source; the last one: limits */
    double cpu;
    double wall; /* seconds; NAN until the last row, which every finished run has */
} score;

/* Take the number of seconds, if the record has that quantity of the run.  Returns 0 if it is no such number. */
static int take_seconds(const report_record *row, const char *quantity, double *seconds)
{
    const char *end;
    if (strcmp(row->field[0], "run") != 0 || strcmp(row->field[REPORT_QUANTITY], quantity) != 0) return 1;
    *seconds = number_of(row->field[REPORT_MEASURED], &end);
    return end != row->field[REPORT_MEASURED] && !*end && *seconds >= 0.0;
}

/* Count one record.  Returns NULL, or what is wrong with it. */
static const char *count_row(score *s, const report_record *row)
{
    const int published = row->field[REPORT_PUBLISHED][0] != '\0';
    int verdict = 0, source = 0;
    while (verdict < REPORT_VERDICTS && strcmp(row->field[REPORT_VERDICT], report_verdict_name(verdict)) != 0) ++verdict;
    if (verdict == REPORT_VERDICTS) return "unknown verdict";
    while (source < REPORT_SOURCES && strcmp(row->field[REPORT_SOURCE], report_source_name(source)) != 0) ++source;
    if (source == REPORT_SOURCES) return "unknown source";
    if (published && source != REPORT_PAPER) return "a published value of another source";
    ++s->verdict[verdict];
    s->published += published;
    if (verdict == REPORT_MATCH) ++s->match[source == REPORT_PAPER && !published ? REPORT_SOURCES : source];

    if (!take_seconds(row, "CPU time [s]", &s->cpu)) return "the CPU time is not a number of seconds";
    if (!take_seconds(row, "wall time [s]", &s->wall)) return "the wall time is not a number of seconds";
    return NULL;
}

static const char *check_header(const report_record *row)
{
    for (int k = 0; k < REPORT_COLUMNS; ++k)
        if (strcmp(row->field[k], report_column_name(k)) != 0) return "the first line is not the header of a report";
    return NULL;
}

/* Read one table.  Returns NULL, or what is wrong; *line counts the records. */
static const char *read_score(FILE *csv, report_record *row, score *s, long *line)
{
    const char *wrong = NULL;
    int status;
    memset(s, 0, sizeof *s);
    s->wall = (double)NAN;
    for (*line = 1; (status = report_read(csv, row)) > 0; ++*line) {
        wrong = *line == 1 ? check_header(row) : count_row(s, row);
        if (wrong) return wrong;
    }
    if (status < 0) return "not nine comma-separated fields and a line end";
    return isnan(s->wall) ? "no wall time: the table is not complete" : NULL;
}

/* What matches are compared with, and the widths of these columns. */
static const char *const matched[REPORT_SOURCES + 1] = {"paper", "theory", "others", "regression", "limit"};
static const int width[REPORT_SOURCES + 1] = {6, 6, 6, 10, 6};

/* The file name without directories and ".csv". */
static void print_score(const char *path, const score *s)
{
    const char *name = path;
    for (const char *c = path; *c; ++c)
        if (*c == '/' || *c == '\\') name = c + 1;
    size_t length = strlen(name);
    if (length > 4 && strcmp(name + length - 4, ".csv") == 0) length -= 4;
    printf("%-3s%-28.*s %9d %6d", s->verdict[REPORT_DIFFERS] ? "!!" : "", (int)length, name, s->published, s->verdict[REPORT_MATCH]);
    for (int k = 0; k <= REPORT_SOURCES; ++k) printf(" %*d", width[k], s->match[k]);
    printf(" %10d %6d %7d %14d %7.0f %8.0f\n", s->verdict[REPORT_CONSISTENT], s->verdict[REPORT_FITTED], s->verdict[REPORT_DIFFERS],
           s->verdict[REPORT_NOT_REPRODUCED], s->cpu, s->wall);
}

static void add_score(score *total, const score *s)
{
    total->published += s->published;
    total->cpu += s->cpu;
    total->wall += s->wall;
    for (int k = 0; k < REPORT_VERDICTS; ++k) total->verdict[k] += s->verdict[k];
    for (int k = 0; k <= REPORT_SOURCES; ++k) total->match[k] += s->match[k];
}

/* Print one file's line and add it to the total.  Returns 0 if it cannot. */
static int count_file(const char *path, report_record *row, score *total)
{
    score s;
    long line;
    errno = 0;
    FILE *csv = fopen(path, "r");
    if (!csv) {
        fprintf(stderr, "scoreboard: %s: %s\n", path, errno ? strerror(errno) : "cannot be read");
        return 0;
    }
    const char *wrong = read_score(csv, row, &s, &line);
    fclose(csv);
    if (wrong) {
        fprintf(stderr, "scoreboard: %s: record %ld: %s\n", path, line, wrong);
        return 0;
    }
    print_score(path, &s);
    add_score(total, &s);
    return 1;
}

int main(int argc, char **argv)
{
    score total = {0};
    report_record row = {0};
    int unread = 0;

    if (argc < 2) {
        fprintf(stderr, "usage: scoreboard FILE.csv ...   (tables that the drivers wrote)\n");
        return 2;
    }
    printf("%-3s%-28s %9s %6s", "", "driver", "published", report_verdict_name(REPORT_MATCH));
    for (int k = 0; k <= REPORT_SOURCES; ++k) printf(" %*s", width[k], matched[k]);
    printf(" %10s %6s %7s %14s %7s %8s\n", report_verdict_name(REPORT_CONSISTENT), report_verdict_name(REPORT_FITTED), report_verdict_name(REPORT_DIFFERS),
           report_verdict_name(REPORT_NOT_REPRODUCED), "CPU [s]", "wall [s]");
    for (int k = 1; k < argc; ++k) unread += !count_file(argv[k], &row, &total);
    print_score("total", &total);
    if (total.verdict[REPORT_MATCH] > 0)
        printf("%d of %d matches are with what a paper prints; the other columns say what the rest is compared with (limit: one that the driver has set)\n",
               total.match[REPORT_PAPER], total.verdict[REPORT_MATCH]);
    free(row.text);
    if (unread) {
        fflush(stdout);
        fprintf(stderr, "scoreboard: %d of %d files not counted\n", unread, argc - 1);
        return 2;
    }
    return total.verdict[REPORT_DIFFERS] ? 1 : 0;
}
