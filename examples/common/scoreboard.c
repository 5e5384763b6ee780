/* SPDX-License-Identifier: MIT */
/*
 * scoreboard [-kept DIR [-compare]] FILE.csv ... - count the verdicts in the tables of report.h.
 *
 * Prints one line per driver and a total.  A match counts under what it was
 * compared with: the paper, theory, other authors, an earlier value of our own
 * (regression), or nothing but a limit that the driver has set (limit).
 * -kept DIR: beside each driver what its long run said, whose table is in DIR under the same name: matches,
 * differs, not reproduced. -compare: these are tables of such long runs: which rows have another verdict than
 * the kept ones, and how far the numbers are apart.
 * Exits with 0, with 1 if any value differs or any verdict has changed, with 2 if a file cannot be read or
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

/* The name of a file without directories and ".csv", and its length. */
static const char *name_of(const char *path, int *length)
{
    const char *name = path;
    for (const char *c = path; *c; ++c)
        if (*c == '/' || *c == '\\') name = c + 1;
    *length = (int)strlen(name);
    if (*length > 4 && strcmp(name + *length - 4, ".csv") == 0) *length -= 4;
    return name;
}
/* kept: the score of the long run, or null */
static void print_score(const char *path, const score *s, const score *kept)
{
    int length;
    const char *const name = name_of(path, &length);
    char full[48] = "-";
    if (kept)
        snprintf(full, sizeof full, "%d/%d/%d", kept->verdict[REPORT_MATCH], kept->verdict[REPORT_DIFFERS],
                 kept->verdict[REPORT_NOT_REPRODUCED]);
    printf("%-3s%-28.*s %9d %6d", s->verdict[REPORT_DIFFERS] ? "!!" : "", length, name, s->published,
           s->verdict[REPORT_MATCH]);
    for (int k = 0; k <= REPORT_SOURCES; ++k) printf(" %*d", width[k], s->match[k]);
    printf(" %10d %6d %7d %14d %7.0f %8.0f %10s\n", s->verdict[REPORT_CONSISTENT], s->verdict[REPORT_FITTED],
           s->verdict[REPORT_DIFFERS], s->verdict[REPORT_NOT_REPRODUCED], s->cpu, s->wall, full);
}

static void add_score(score *total, const score *s)
{
    total->published += s->published;
    total->cpu += s->cpu;
    total->wall += s->wall;
    for (int k = 0; k < REPORT_VERDICTS; ++k) total->verdict[k] += s->verdict[k];
    for (int k = 0; k <= REPORT_SOURCES; ++k) total->match[k] += s->match[k];
}

/* The score of the table at path. Returns 1; 0 and a message if it cannot be read. */
static int score_of(const char *path, report_record *row, score *s)
{
    long line;
    errno = 0;
    FILE *csv = fopen(path, "r");
    if (!csv) {
        fprintf(stderr, "scoreboard: %s: %s\n", path, errno ? strerror(errno) : "cannot be read");
        return 0;
    }
    const char *wrong = read_score(csv, row, s, &line);
    fclose(csv);
    if (wrong) fprintf(stderr, "scoreboard: %s: record %ld: %s\n", path, line, wrong);
    return !wrong;
}

/* ---- the tables of long runs ---- */

/* DIR/NAME.csv of the same name, if there is such a file */
static int kept_path(char path[PART_FILE_PATH], const char *dir, const char *of)
{
    int length;
    const char *const name = name_of(of, &length);
    if (!dir || snprintf(path, PART_FILE_PATH, "%s/%.*s.csv", dir, length, name) >= PART_FILE_PATH) return 0;
    FILE *const there = fopen(path, "r");
    if (there) fclose(there);
    return there != NULL;
}

static int same_row(const report_record *a, const report_record *b)
{
    return strcmp(a->field[0], b->field[0]) == 0 && strcmp(a->field[1], b->field[1]) == 0 &&
           strcmp(a->field[REPORT_QUANTITY], b->field[REPORT_QUANTITY]) == 0;
}
/* The next row of the kept table that is of the same item, setting and quantity. 0: there is none, and the
 * place in the table is as before. */
static int find_row(FILE *then, report_record *b, const report_record *a)
{
    const long place = ftell(then);
    while (report_read(then, b) > 0)
        if (same_row(a, b)) return 1;
    fseek(then, place, SEEK_SET);
    return 0;
}
/* Compares what two runs of one driver measured, row by row in the order of the tables, of which the kept one
 * may hold less. Prints what has another verdict. Returns the number of these, or -1 if a table cannot be
 * read. */
static int compare(const char *path, const char *kept_file)
{
    report_record a = {0}, b = {0};
    FILE *const now = fopen(path, "r"), *const then = fopen(kept_file, "r");
    int changed = 0, rows = 0, more = 0, numbers = 0, length, status = now && then ? 1 : -1;
    double largest = 0, sum = 0;
    char where[256] = "";
    const char *const name = name_of(path, &length);
    if (status > 0 && (report_read(now, &a) <= 0 || report_read(then, &b) <= 0)) status = -1; /* the header */
    while (status > 0 && (status = report_read(now, &a)) > 0) {
        const char *end_a, *end_b;
        if (strcmp(a.field[0], "run") == 0) break; /* seconds, at the end */
        if (!find_row(then, &b, &a)) {
            more++;
            continue;
        }
        rows++;
        if (strcmp(a.field[REPORT_VERDICT], b.field[REPORT_VERDICT]) != 0) {
            printf("%.*s: %s, %s, %s: %s (%s), kept %s (%s)\n", length, name, a.field[0], a.field[1],
                   a.field[REPORT_QUANTITY], a.field[REPORT_VERDICT], a.field[REPORT_MEASURED],
                   b.field[REPORT_VERDICT], b.field[REPORT_MEASURED]);
            changed++;
        }
        const double x = number_of(a.field[REPORT_MEASURED], &end_a), y = number_of(b.field[REPORT_MEASURED], &end_b);
        if (end_a == a.field[REPORT_MEASURED] || *end_a || end_b == b.field[REPORT_MEASURED] || *end_b) continue;
        const double size = fmax(fabs(x), fabs(y)), apart = size < 1e-12 ? 0 : fabs(x - y) / size; /* not of rounding errors */
        numbers++;
        sum += apart;
        if (apart > largest) {
            largest = apart;
            snprintf(where, sizeof where, " (%.60s, %.60s, %.60s)", a.field[0], a.field[1], a.field[REPORT_QUANTITY]);
        }
    }
    if (status >= 0)
        printf("%.*s: %d rows beside the kept ones, %d with another verdict; %d numbers are apart by %.2g on average, "
               "by %.2g at most%s; %d rows without a kept one\n",
               length, name, rows, changed, numbers, numbers ? sum / numbers : 0, largest, where, more);
    else fprintf(stderr, "scoreboard: %s and %s cannot be compared\n", path, kept_file);
    if (now) fclose(now);
    if (then) fclose(then);
    free(a.text);
    free(b.text);
    return status >= 0 ? changed : -1;
}

int main(int argc, char **argv)
{
    const char *kept = NULL;
    char path[PART_FILE_PATH];
    score total = {0}, all_kept = {0};
    report_record row = {0};
    int unread = 0, changed = 0, compares = 0, first = 1, files = 0;

    if (first + 1 < argc && strcmp(argv[first], "-kept") == 0) {
        kept = argv[first + 1];
        first += 2;
        if (first < argc && strcmp(argv[first], "-compare") == 0) compares = first++;
    }
    if (first >= argc || argv[first][0] == '-') {
        fprintf(stderr, "usage: scoreboard [-kept DIR [-compare]] FILE.csv ...   (tables that the drivers wrote)\n");
        return 2;
    }
    printf("%-3s%-28s %9s %6s", "", "driver", "published", report_verdict_name(REPORT_MATCH));
    for (int k = 0; k <= REPORT_SOURCES; ++k) printf(" %*s", width[k], matched[k]);
    printf(" %10s %6s %7s %14s %7s %8s %10s\n", report_verdict_name(REPORT_CONSISTENT),
           report_verdict_name(REPORT_FITTED), report_verdict_name(REPORT_DIFFERS),
           report_verdict_name(REPORT_NOT_REPRODUCED), "CPU [s]", "wall [s]", "long run");
    for (int k = first; k < argc; ++k) {
        score s, long_run;
        const int has_kept = kept_path(path, kept, argv[k]);
        if (!score_of(argv[k], &row, &s) || (has_kept && !score_of(path, &row, &long_run))) {
            unread++;
            continue;
        }
        print_score(argv[k], &s, has_kept ? &long_run : NULL);
        add_score(&total, &s);
        files += has_kept;
        if (has_kept) add_score(&all_kept, &long_run);
    }
    print_score("total", &total, files ? &all_kept : NULL);
    if (total.verdict[REPORT_MATCH] > 0)
        printf("%d of %d matches are with what a paper prints; the other columns say what the rest is compared with (limit: one that the driver has set)\n",
               total.match[REPORT_PAPER], total.verdict[REPORT_MATCH]);
    if (files)
        printf("long run: match/differs/not-reproduced of the runs whose tables are kept in %s; they took %.1f hours of processor time\n",
               kept, all_kept.cpu / 3600);
    free(row.text);
    for (int k = first; compares && k < argc; ++k)
        if (kept_path(path, kept, argv[k])) {
            const int count = compare(argv[k], path);
            if (count < 0) unread++;
            else changed += count;
        }
    if (unread) {
        fflush(stdout);
        fprintf(stderr, "scoreboard: %d of %d files not counted\n", unread, argc - first);
        return 2;
    }
    return total.verdict[REPORT_DIFFERS] || changed ? 1 : 0;
}
