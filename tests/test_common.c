/* SPDX-License-Identifier: MIT */
/*
 * test_common [DIR] - what the example drivers share.  Writes and removes
 * small files in DIR (default: the current directory).
 */
#include "check.h"

#include "../examples/common/banded.h"
#include "../examples/common/options.h"
#include "../examples/common/progress.h"
#include "../examples/common/random.h"
#include "../examples/common/report.h"
#include "../examples/common/statistics.h"
#include "../examples/common/vtk.h"

/* ---- random.h ---------------------------------------------------------- */

static void test_random(void)
{
    /* The first round of pcg32-demo in O'Neill's distribution. */
    static const uint32_t known[] = {0xa15c02b7U, 0x7b47f409U, 0xba1d3330U,
                                     0x83d2f293U, 0xbfa4784bU, 0xcbed606eU};
    pcg32 g;
    pcg32_seed(&g, 42, 54);
    for (int k = 0; k < 6; ++k)
        CHECK(pcg32_next(&g) == known[k]);

    /* The bits of a uniform number, from the first two of those draws. */
    pcg32_seed(&g, 42, 54);
    const double expected = ((double)(0xa15c02b7U >> 5) * 67108864.0 + (0x7b47f409U >> 6)) /
                            9007199254740992.0;
    CHECK(pcg32_uniform(&g) == expected);

    enum { N = 100000 };
    double mean = 0.0, square = 0.0, least = 1.0, most = 0.0;
    for (int k = 0; k < N; ++k) {
        const double u = pcg32_uniform(&g);
        mean += u / N;
        square += u * u / N;
        least = fmin(least, u);
        most = fmax(most, u);
    }
    CHECK(least > 0.0 && most < 1.0);
    CHECK_CLOSE(mean, 1.0 / 2.0, 5.0 * sqrt(1.0 / 12.0 / N));
    CHECK_CLOSE(square, 1.0 / 3.0, 5.0 * sqrt(4.0 / 45.0 / N));
}

/* ---- banded.h ---------------------------------------------------------- */

static double *new_doubles(size_t count)
{
    double *memory = malloc((count ? count : 1) * sizeof *memory);
    if (!memory) {
        fprintf(stderr, "test_common: no memory\n");
        exit(2);
    }
    return memory;
}

/* Dense Gaussian elimination with partial pivoting: the reference. */
static void dense_solve(double *a, double *b, int n)
{
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int i = k + 1; i < n; ++i)
            if (fabs(a[i * n + k]) > fabs(a[pivot * n + k]))
                pivot = i;
        if (pivot != k) {
            banded_swap(a + k * n, a + pivot * n, n);
            banded_swap(b + k, b + pivot, 1);
        }
        for (int i = k + 1; i < n; ++i) {
            const double l = a[i * n + k] / a[k * n + k];
            banded_axpy(a + i * n, l, a + k * n, n);
            b[i] -= l * b[k];
        }
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int j = i + 1; j < n; ++j)
            b[i] -= a[i * n + j] * b[j];
        b[i] /= a[i * n + i];
    }
}

/* A random system; diagonal scales the main diagonal: 0 makes every column
 * need an exchange if it can have one, a large value makes none need one. */
static void compare_with_dense(int n, int kl, int ku, double diagonal, pcg32 *g)
{
    const size_t nn = (size_t)n * (size_t)n;
    double *dense = new_doubles(nn), *copy = new_doubles(nn);
    double *b = new_doubles((size_t)n), *x = new_doubles((size_t)n), *y = new_doubles((size_t)n);
    double *memory = new_doubles(banded_size(n, kl, ku));
    banded A = banded_make(memory, n, kl, ku);
    banded_zero(&A);

    for (int i = 0; i < n; ++i) {
        b[i] = x[i] = y[i] = pcg32_uniform(g) - 0.5;
        for (int j = 0; j < n; ++j) {
            const int inside = j >= i - kl && j <= i + ku;
            const double value = (pcg32_uniform(g) - 0.5) * (i == j ? diagonal : 1.0);
            dense[i * n + j] = copy[i * n + j] = inside ? value : 0.0;
            if (inside) { /* in two parts: entries add up */
                banded_add(&A, i, j, 0.5 * value);
                banded_add(&A, i, j, 0.5 * value);
            }
        }
    }
    dense_solve(copy, y, n);
    CHECK(banded_factor_solve(&A, x) == 0);

    double x_size = 0.0, difference = 0.0, residual = 0.0;
    for (int i = 0; i < n; ++i) {
        double sum = -b[i];
        for (int j = 0; j < n; ++j)
            sum += dense[i * n + j] * x[j];
        residual = fmax(residual, fabs(sum));
        x_size = fmax(x_size, fabs(y[i]));
        difference = fmax(difference, fabs(x[i] - y[i]));
    }
    CHECK(x_size > 0.0);
    CHECK_CLOSE(residual / (1.0 + n * (1.0 + diagonal) * x_size), 0.0, 1e-13);
    CHECK_CLOSE(difference / x_size, 0.0, 1e-8);

    free(dense);
    free(copy);
    free(b);
    free(x);
    free(y);
    free(memory);
}

static void test_banded_solutions(void)
{
    /* Sizes on both sides of multiples of the panel width, bands that are
     * narrow, lopsided and wider than the matrix. */
    static const int size[] = {1, 2, 3, 4, 5, 8, 13, 40, 67};
    static const int band[][2] = {{1, 1}, {2, 2}, {1, 5}, {5, 1}, {3, 4},
                                  {7, 7}, {20, 3}, {3, 20}, {30, 30}, {100, 100}};
    pcg32 g;
    pcg32_seed(&g, 1, 1);
    for (int s = 0; s < 9; ++s)
        for (int k = 0; k < 10; ++k) {
            compare_with_dense(size[s], band[k][0], band[k][1], 1.0, &g);
            compare_with_dense(size[s], band[k][0], band[k][1], 1000.0, &g);
            if (size[s] % 2 == 0)
                compare_with_dense(size[s], band[k][0], band[k][1], 0.0, &g);
        }
    compare_with_dense(7, 0, 0, 1.0, &g);
    compare_with_dense(7, 0, 3, 1000.0, &g);
    compare_with_dense(7, 3, 0, 1000.0, &g);
}

/* A tridiagonal matrix with `value` in place of the column: status expected. */
static int status_with_column(int n, int column, double value)
{
    double b[16] = {0.0};
    double *memory = new_doubles(banded_size(n, 1, 1));
    banded A = banded_make(memory, n, 1, 1);
    banded_zero(&A);
    for (int i = 0; i < n; ++i)
        for (int j = i > 0 ? i - 1 : 0; j <= i + 1 && j < n; ++j)
            banded_add(&A, i, j, j == column ? value : i == j ? 4.0 : 1.0);
    const int status = banded_factor_solve(&A, b);
    free(memory);
    return status;
}

static void test_banded_refusals(void)
{
    for (int n = 1; n <= 10; ++n)
        for (int column = 0; column < n; ++column) {
            CHECK(status_with_column(n, column, 0.0) == 1 + column);
            CHECK(status_with_column(n, column, (double)NAN) == 1 + column);
            CHECK(status_with_column(n, column, HUGE_VAL) == 1 + column);
        }
    CHECK(banded_size(0, 1, 1) == 0);
    CHECK(banded_size(5, -1, 1) == 0);
    CHECK(banded_size(5, 1, -1) == 0);
    CHECK(banded_size(INT_MAX, INT_MAX / 2, INT_MAX / 2) == 0);
    CHECK(banded_size(INT_MAX, INT_MAX, INT_MAX) == 0);
    CHECK(banded_size(5, 4, 4) == banded_size(5, INT_MAX, INT_MAX));
    CHECK(banded_size(1281, 500, 500) == 1281U * (1501U + 6U));
}

/* ---- statistics.h ------------------------------------------------------ */

static void test_statistics(void)
{
    double v[] = {4.0, 1.0, 3.0, 2.0};
    statistics_sort(v, 4);
    CHECK(v[0] == 1.0 && v[1] == 2.0 && v[2] == 3.0 && v[3] == 4.0);

    CHECK(statistics_quantile(v, 4, 0.0) == 1.0);
    CHECK(statistics_quantile(v, 4, 1.0) == 4.0);
    CHECK(statistics_quantile(v, 4, 0.5) == 2.5);
    CHECK_RELATIVE(statistics_quantile(v, 4, 0.1), 1.3, 1e-15); /* R: quantile(1:4, 0.1) */
    CHECK(statistics_quantile(v, 1, 0.7) == 1.0);
    CHECK(isnan(statistics_quantile(v, 0, 0.5)));
    CHECK(isnan(statistics_quantile(v, 4, 1.5)));
    CHECK(isnan(statistics_quantile(v, 4, (double)NAN)));

    CHECK(statistics_rank(v, 4, 0.0) == 0.0);
    CHECK(statistics_rank(v, 4, 5.0) == 1.0);
    CHECK(statistics_rank(v, 4, 2.5) == 0.5);
    CHECK(statistics_rank(v, 4, 2.0) == 0.375);

    double w[] = {(double)NAN, 2.0, -HUGE_VAL, (double)NAN, 1.0};
    statistics_sort(w, 5);
    CHECK(w[0] == -HUGE_VAL && w[1] == 1.0 && w[2] == 2.0 && isnan(w[3]) && isnan(w[4]));

    const double x[] = {1e6, 1e6 + 1.0, 1e6 + 2.0}, y[] = {5.0, 2.0, -1.0}, z[] = {0.0, 1.0, 0.0};
    CHECK_RELATIVE(statistics_slope(x, y, 3), -3.0, 1e-9);
    CHECK_CLOSE(statistics_slope(x, z, 3), 0.0, 1e-9);
    CHECK(isnan(statistics_slope(x, y, 1)));
}

/* ---- number.h ---------------------------------------------------------- */

static void check_number(const char *text, double value, int length)
{
    const char *end;
    const double found = number_of(text, &end);
    CHECK(end == text + length);
    CHECK(length == 0 || found == value);
}

/* In the locale that is set. */
static void check_numbers(void)
{
    static const char *const text[] = {"0", "-0.5", "1e+300", "1.5", "0.333333333", "-1.25e-07", "12345.678"};
    static const double value[] = {0, -0.5, 1e300, 1.5, 1.0 / 3, -1.25e-7, 12345.678};
    char buffer[NUMBER_TEXT], longest[NUMBER_LONGEST + 1];
    for (int k = 0; k < 7; ++k) {
        CHECK(strcmp(number_text(buffer, 9, value[k]), text[k]) == 0);
        check_number(number_text(buffer, 17, value[k]), value[k], (int)strlen(number_text(buffer, 17, value[k])));
    }
    CHECK(strcmp(number_text(buffer, 9, HUGE_VAL), "inf") == 0);
    check_number("1.5mm", 1.5, 3);
    check_number("1,5", 1, 1);
    check_number(".5", 0.5, 2);
    check_number("5.", 5, 2);
    check_number("+2.5E+1-1", 25, 7);
    check_number("1.5.5", 1.5, 3);
    check_number("1.5e", 1.5, 3);
    check_number("1.e", 1, 2);
    check_number("0x10", 0, 1);
    static const char *const none[] = {"", " 1", "nan", "inf", "x", ".", "-", "e5", "+.e1"};
    for (int k = 0; k < 9; ++k)
        check_number(none[k], 0, 0);
    memset(longest, '0', sizeof longest);
    memcpy(longest, "1.5", 3);
    longest[NUMBER_LONGEST - 1] = '\0';
    check_number(longest, 1.5, NUMBER_LONGEST - 1);
    longest[NUMBER_LONGEST - 1] = '0';
    longest[NUMBER_LONGEST] = '\0';
    check_number(longest, 0, 0);
}

static void test_numbers(void)
{
    static const char *const comma[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE", "de-DE"};
    char before[256];
    int k = 0;
    snprintf(before, sizeof before, "%s", setlocale(LC_ALL, NULL));
    check_numbers();
    while (k < 5 && (!setlocale(LC_ALL, comma[k]) || strcmp(localeconv()->decimal_point, ",") != 0))
        ++k;
    if (k < 5) check_numbers(); /* tests/files.sh makes such a locale where none is installed */
    CHECK(setlocale(LC_ALL, before) != NULL);
}

/* ---- options.h --------------------------------------------------------- */

static void test_options(void)
{
    int n = 5, flag = 0, any = 0;
    double h = 0.5;
    const char *out = ".";
    const option_spec specs[] = {
        {"n", "count", OPTION_INT, &n, 1, 100},    {"any", "count", OPTION_INT, &any, 0, 0},
        {"x", "length", OPTION_REAL, &h, 0, 2},    {"out", "directory", OPTION_TEXT, &out, 0, 0},
        {"flag", "a switch", OPTION_FLAG, &flag, 0, 0},
    };
    static const char *const bad_int[] = {"", "x", "7x", "7.0", "1e1", "0", "101",
                                          "99999999999999999999", "nan"};
    static const char *const bad_real[] = {"", "x", "1.5mm", "-0.1", "2.1", "nan", "inf", "1e999", "1,5"};
    for (int k = 0; k < 9; ++k)
        CHECK(!option_set(&specs[0], bad_int[k]) && n == 5);
    for (int k = 0; k < 9; ++k)
        CHECK(!option_set(&specs[2], bad_real[k]) && h == 0.5);
    CHECK(!option_set(&specs[1], "2147483648"));
    CHECK(option_set(&specs[1], "-2147483647") && any == -2147483647);

    char program[] = "p", a0[] = "-n", a1[] = "100", a2[] = "-flag", a3[] = "-out", a4[] = "-n";
    char *argv[] = {program, a0, a1, a2, a3, a4, NULL};
    options_parse(6, argv, "about", specs, 5);
    CHECK(n == 100 && flag == 1 && h == 0.5);
    CHECK(strcmp(out, "-n") == 0); /* a value may look like an option */
}

/* ---- report.h ---------------------------------------------------------- */

static const char *const awkward[] = {"plain", "a, b", "say \"so\"", "\"", "two\nlines", "cr\rlf",
                                      ",", "", " spaces ", "\"\",\"\""};
enum { AWKWARD = 10 };

static int write_report(const char *dir, char *path)
{
    static report r;
    static char wide[3000]; /* longer than any buffer of the reader */
    memset(wide, '"', sizeof wide - 1);

    report_open(&r, "test_common_report", dir);
    r.screen = tmpfile();
    if (!r.screen) {
        fprintf(stderr, "test_common: no temporary file\n");
        exit(2);
    }
    strcpy(path, r.file.path);
    report_section(&r, "a section");
    for (int k = 0; k < AWKWARD; ++k)
        report_claim(&r, awkward[k], awkward[(k + 1) % AWKWARD], awkward[(k + 2) % AWKWARD],
                     awkward[(k + 3) % AWKWARD], wide, awkward[(k + 4) % AWKWARD], 1);
    report_relative(&r, "i", "s", "q", 2.0, 2.000001, 1e-6);
    report_relative(&r, "i", "s", "q", 2.0, 2.000003, 1e-6);
    report_relative(&r, "i", "s", "q", 2.0, (double)NAN, 1e-6);
    report_relative(&r, "i", "s", "q", 0.0, 0.0, 1e-6);
    report_absolute(&r, "i", "s", "q", 0.0, -1e-7, 1e-6);
    report_absolute(&r, "i", "s", "q", 0.0, -2e-6, 1e-6);
    report_range(&r, "i", "s", "q", (double)NAN, 0.5, 0.0, 1.0);
    report_range(&r, "i", "s", "q", 0.5, 1.5, 0.0, 1.0);
    report_range(report_beside(&r, REPORT_THEORY), "i", "s", "q", 1.0, 1.0, 0.0, 1.0);
    report_factor(report_beside(&r, REPORT_OTHERS), "i", "s", "q", 2.0, 3.0, 1.5);
    report_factor(report_beside(&r, REPORT_REGRESSION), "i", "s", "q", 3.0, 1.9, 1.5);
    report_factor(&r, "i", "s", "q", 3.0, (double)NAN, 1.5);
    report_absolute(report_with_fit(&r), "i", "s", "q", 1.0, 1.25, 0.5);
    report_absolute(report_with_fit(&r), "i", "s", "q", 1.0, 1.75, 0.5);
    report_absolute(&r, "i", "s", "q", 1.0, 1.25, 0.5); /* neither source nor fit stays on */
    report_band(&r, "i", "s", "q", 0.5, 0.6, 0.0, 1.0, REPORT_NOT_REPRODUCED, "chance");
    report_band(&r, "i", "s", "q", 1.5, 0.6, 0.0, 1.0, REPORT_NOT_REPRODUCED, "chance, \"most\"");
    report_claim(&r, "i", "s", "q", NULL, "no", "falls", 0);
    report_claim_known(&r, "i", "s", "q", "p", "m", "falls", 1, 1, "why");
    report_claim_known(&r, "i", "s", "q", "p", "m", "falls", 0, 1, "why");
    report_claim_known(&r, "i", "s", "q", "p", "m", "falls", 0, 0, "why");
    report_claim_known(&r, "i", "s", "q", "p", "m", "falls", 1, 0, "why");
    report_not_reproduced(&r, "i", "s", "q", 1.0 / 3.0, 2.0, "misprint");
    report_info(&r, "i", "s", "q", 1e-300);
    const int differs = report_close(&r);
    fclose(r.screen);
    return differs;
}

static void check_record(const report_record *row, const char *const *expected)
{
    CHECK(strcmp(row->field[0], "i") == 0);
    CHECK(strcmp(row->field[1], "s") == 0);
    CHECK(strcmp(row->field[2], "q") == 0);
    for (int k = 0; k < 6; ++k)
        CHECK(strcmp(row->field[REPORT_PUBLISHED + k], expected[k]) == 0);
}

static void check_awkward_rows(FILE *csv, report_record *row)
{
    for (int k = 0; k < AWKWARD && report_read(csv, row) == 1; ++k) {
        for (int column = 0; column < 4; ++column)
            CHECK(strcmp(row->field[column], awkward[(k + column) % AWKWARD]) == 0);
        CHECK(strlen(row->field[REPORT_MEASURED]) == 2999 && strspn(row->field[REPORT_MEASURED], "\"") == 2999);
        CHECK(strcmp(row->field[REPORT_JUDGED_BY], awkward[(k + 4) % AWKWARD]) == 0);
        CHECK(strcmp(row->field[REPORT_VERDICT], "match") == 0);
    }
}

static void test_report(const char *dir)
{
    /* published, reference, source, measured, criterion, verdict */
    static const char *const expected[][6] = {
        {"2", "", "", "2.000001", "rel <= 1e-06", "match"},
        {"2", "", "", "2.000003", "rel <= 1e-06", "differs"},
        {"2", "", "", "nan", "rel <= 1e-06", "differs"},
        {"0", "", "", "0", "rel <= 1e-06", "differs"},
        {"0", "", "", "-1e-07", "abs <= 1e-06", "match"},
        {"0", "", "", "-2e-06", "abs <= 1e-06", "differs"},
        {"", "", "", "0.5", "in [0, 1]", "match"},
        {"0.5", "", "", "1.5", "in [0, 1]", "differs"},
        {"", "1", "theory", "1", "in [0, 1]", "match"},
        {"", "2", "other authors", "3", "within a factor of 1.5", "match"},
        {"", "3", "regression", "1.9", "within a factor of 1.5", "differs"},
        {"3", "", "", "nan", "within a factor of 1.5", "differs"},
        {"1", "", "", "1.25", "abs <= 0.5", "fitted"},
        {"1", "", "", "1.75", "abs <= 0.5", "differs"},
        {"1", "", "", "1.25", "abs <= 0.5", "match"},
        {"0.5", "", "", "0.6", "published in [0, 1]", "consistent"},
        {"1.5", "", "", "0.6", "published in [0, 1]; chance, \"most\"", "not-reproduced"},
        {"", "", "", "no", "falls", "differs"},
        {"p", "", "", "m", "falls", "match"},
        {"p", "", "", "m", "falls", "differs"},
        {"p", "", "", "m", "why", "not-reproduced"},
        {"p", "", "", "m", "known not to hold, but it does", "differs"},
        {"0.333333333", "", "", "2", "misprint", "not-reproduced"},
        {"", "", "", "1e-300", "", "info"},
    };
    enum { ROWS = sizeof expected / sizeof *expected };
    char path[PART_FILE_PATH];
    CHECK(write_report(dir, path) == 11);
    CHECK(write_report(dir, path) == 11); /* replaces the first */

    FILE *csv = fopen(path, "r");
    CHECK(csv != NULL);
    if (!csv)
        return;
    report_record row = {0};
    CHECK(report_read(csv, &row) == 1 && strcmp(row.field[0], "item") == 0);
    check_awkward_rows(csv, &row);
    for (int k = 0; k < ROWS; ++k) {
        CHECK(report_read(csv, &row) == 1);
        check_record(&row, expected[k]);
    }
    CHECK(report_read(csv, &row) == 1 && strcmp(row.field[2], "CPU time [s]") == 0);
    CHECK(report_read(csv, &row) == 1 && strcmp(row.field[2], "wall time [s]") == 0);
    CHECK(report_read(csv, &row) == 0);
    fclose(csv);
    free(row.text);
    CHECK(remove(path) == 0);
}

/* What report_read says of a text on its own. */
static int status_of(const char *text)
{
    report_record row = {0};
    FILE *csv = tmpfile();
    if (!csv)
        return -2;
    fputs(text, csv);
    rewind(csv);
    const int status = report_read(csv, &row);
    fclose(csv);
    free(row.text);
    return status;
}

/* ---- vtk.h ------------------------------------------------------------- */

/* a run that goes on from time `from` keeps the pictures from before */
static void test_series(const char *dir)
{
    static const struct {
        double from;
        int kept;
    } cases[] = {{3, 3}, {2.5, 3}, {2, 2}, {0.1, 1}, {0, 0}};
    const double x = 0;
    char path[PART_FILE_PATH];
    vtk_series s;
    int k, c;
    for (c = 0; c < (int)(sizeof cases / sizeof *cases); c++) {
        vtk_series_begin(&s, dir, "test_series");
        for (k = 0; k < 3; k++) CHECK(vtk_series_add(&s, k, 1, &x, &x, NULL, NULL, 0));
        vtk_series_end(&s);
        vtk_series_begin(&s, dir, "test_series");
        vtk_series_resume(&s, cases[c].from);
        CHECK(s.count == cases[c].kept);
        CHECK(vtk_series_add(&s, 7, 1, &x, &x, NULL, NULL, 0));
        vtk_series_end(&s);
        vtk_series_begin(&s, dir, "test_series");
        vtk_series_resume(&s, 8);
        CHECK(s.count == cases[c].kept + 1);
        for (k = 0; k < s.count; k++) CHECK(s.time[k] == (k < cases[c].kept ? k : 7));
        vtk_series_end(&s);
    }
    for (k = 0; k < 4; k++) {
        snprintf(path, sizeof path, "%s/test_series_%04d.vtu", dir, k);
        remove(path);
    }
    snprintf(path, sizeof path, "%s/test_series.pvd", dir);
    FILE *const other = fopen(path, "wb"); /* another program's line ends, and a time that is none */
    CHECK(other && fputs("<DataSet timestep=\"0.5\" file=\"a\"/>\r\n<DataSet timestep=\"\" file=\"b\"/>\r\n", other) >= 0 &&
          fclose(other) == 0);
    vtk_series_begin(&s, dir, "test_series");
    vtk_series_resume(&s, 8);
    CHECK(s.count == 1 && s.time[0] == 0.5);
    vtk_series_end(&s);
    CHECK(remove(path) == 0);
    vtk_series_begin(&s, dir, "test_series");
    vtk_series_resume(&s, 8);
    CHECK(s.count == 0);
}

static void test_malformed(void)
{
    CHECK(status_of("") == 0);
    CHECK(status_of("a,b,c,d,e,f,x,y,g\n") == 1);
    CHECK(status_of("a,b,c,d,e,f,x,y,g\r\n") == 1);
    CHECK(status_of(",,,,,,,,\n") == 1);
    CHECK(status_of("\"a\",b,c,d,e,f,x,y,\"g\"\n") == 1);
    CHECK(status_of("a,b,c,d,e,f,x,y,g") == -1);
    CHECK(status_of("a,b,c,d,e,f,g,h\n") == -1);
    CHECK(status_of("a,b,c,d,e,f,g,h,i,j\n") == -1);
    CHECK(status_of("\n") == -1);
    CHECK(status_of("a,b,c,d,e,f,x,y,\"g\n") == -1);
    CHECK(status_of("a,b,c,d,e,f,x,y,\"g\"x\n") == -1);
    CHECK(status_of("a,b,c,d,e,f,x,y,g\"x\"\n") == -1);
    CHECK(status_of("a,b,c,d,e,f,x,y,\"g\"") == -1);
}

static void test_progress(void)
{
    progress p;
    progress_begin(&p, "test", 0);
    progress_update(&p, 0.0); /* nothing done yet: no line, no division */
    progress_update(&p, 0.5);
    CHECK(difftime(p.shown, p.start) == 0.0); /* too early for a line */
    progress_end(&p);
}

int main(int argc, char **argv)
{
    const char *dir = argc > 1 ? argv[1] : getenv("BUILD"); /* where files are written */
    test_random();
    test_banded_solutions();
    test_banded_refusals();
    test_statistics();
    test_numbers();
    test_report(dir ? dir : ".");
    test_series(dir ? dir : ".");
    test_malformed();
    test_progress();
    test_options(); /* last: from here on the locale of numbers is "C" */
    return check_report("test_common");
}
