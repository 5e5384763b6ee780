/* SPDX-License-Identifier: MIT */
/*
 * test_known_answers.c - every kernel against tests/known/kernels.csv, whose values
 * derive_kernels.py computes from the definitions in exact arithmetic.
 *
 *     test_known_answers [path of kernels.csv]
 *
 * With KNOWN_ANSWERS_VERBOSE in the environment the largest deviation of each quantity is printed.
 */
#include "../sph_kernels.h"
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* In units of SPH_EPSILON, of the value for sigma (a rounded constant) and else of the largest value of the quantity over q.
   The largest deviation seen with gcc and clang, in double and in float, with and without fused multiplication, is 2.76 (F next to a cusp, which is
   compared with itself; next is 2.58 of dW/dr). r (1/h) and the powers of 1/h alone are six roundings, so 4 leaves room for another order of
   evaluation and for little else. */
#define TOLERANCE 4.0
#define TOLERANCE_SIGMA 0.5

enum { MAX_ROWS = 4096, LINE = 1024 };
enum { SIGMA, W, DWDR, F, D2WDR2, DWDH, QUANTITIES };
enum { FIRST_QUANTITY = 4, COLUMNS = FIRST_QUANTITY + QUANTITIES };

static const char *const quantity_name[QUANTITIES] = {"sigma", "W", "dWdr", "F", "d2Wdr2", "dWdh"};
static const char header[] = "kernel,dim,h,r,sigma,W,dWdr,F,d2Wdr2,dWdh";

typedef struct known_row {
    int line, kernel, dim;
    double h, r, value[QUANTITIES];
} known_row;

static known_row row[MAX_ROWS];
static int rows;

static double power_of_h(double h, int dim, int quantity)
{
    const int more[QUANTITIES] = {0, 0, 1, 2, 2, 1};
    double p = 1.0;
    int i;
    if (quantity == SIGMA) return 1.0;
    for (i = 0; i < dim + more[quantity]; i++) p *= h;
    return p;
}

/* One line of the file. Returns 0 if it is not what it should be. */
static int parse(char *text, int line, known_row *out)
{
    char *field[COLUMNS], *end;
    int i;
    for (i = 0; i < COLUMNS; i++) {
        field[i] = text;
        end = text + strcspn(text, ",");
        if ((*end == ',') != (i + 1 < COLUMNS)) return 0;
        *end = '\0';
        text = end + 1;
    }
    out->line = line;
    out->kernel = sph_kernel_from_name(field[0]);
    if (out->kernel < 0) {
        fprintf(stderr, "kernels.csv:%d: sph_kernel_from_name does not know '%s'\n", line, field[0]);
        return 0;
    }
    /* the name is the kernel's own one, not an alias of another kernel */
    if (strcmp(sph_kernel_name((sph_kernel)out->kernel), field[0]) != 0) return 0;
    out->dim = atoi(field[1]);
    if (out->dim < 1 || out->dim > 3) return 0;
    for (i = 2; i < COLUMNS; i++) {
        const double x = strtod(field[i], &end);
        if (end == field[i] || *end != '\0') return 0;
        if (i == 2) out->h = x;
        else if (i == 3) out->r = x;
        else out->value[i - FIRST_QUANTITY] = x;
    }
    return out->h > 0.0 && out->r >= 0.0;
}

static int read_rows(const char *path)
{
    char text[LINE];
    int line = 0, headed = 0;
    FILE *file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "test_known_answers: cannot read '%s'; run from the repository root, or name the file\n", path);
        return 0;
    }
    while (fgets(text, LINE, file)) {
        line++;
        text[strcspn(text, "\r\n")] = '\0';
        if (text[0] == '#' || text[0] == '\0') continue;
        if (!headed) {
            headed = 1;
            CHECK(strcmp(text, header) == 0);
        } else if (rows == MAX_ROWS) {
            fprintf(stderr, "%s:%d: more than %d rows\n", path, line, (int)MAX_ROWS);
            check_count(0);
            break;
        } else if (check_count(parse(text, line, &row[rows]))) {
            rows++;
        } else {
            fprintf(stderr, "%s:%d: not a row of known answers\n", path, line);
        }
    }
    CHECK(!ferror(file));
    fclose(file);
    return rows > 0;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "tests/known/kernels.csv";
    const double epsilon = (double)SPH_EPSILON;
    static double scale[SPH_KERNEL_COUNT][4][QUANTITIES]; /* the largest value, for h = 1 */
    double worst[QUANTITIES] = {0};
    int worst_line[QUANTITIES] = {0}, i, k, dim, quantity;

    if (!read_rows(path)) {
        check_count(0);
        return check_report("test_known_answers");
    }

    for (i = 0; i < rows; i++)
        for (quantity = 0; quantity < QUANTITIES; quantity++) {
            const double a = fabs(row[i].value[quantity]);
            double *s = &scale[row[i].kernel][row[i].dim][quantity];
            if (row[i].h == 1.0 && a > *s) *s = a;
        }
    for (k = 0; k < SPH_KERNEL_COUNT; k++)
        for (dim = 1; dim <= 3; dim++)
            for (quantity = 0; quantity < QUANTITIES; quantity++)
                if (!check_count(scale[k][dim][quantity] > 0.0))
                    fprintf(stderr, "%s: no %s of %s in %d dimensions\n", path, quantity_name[quantity], sph_kernel_name((sph_kernel)k), dim);

    for (i = 0; i < rows; i++) {
        const known_row *a = &row[i];
        const sph_kernel kernel = (sph_kernel)a->kernel;
        const sph_real r = SPH_R(a->r), h = SPH_R(a->h);
        const int outside = a->r >= a->h * (double)sph_kernel_support_ratio(kernel);
        double got[QUANTITIES];

        CHECK((double)r == a->r && (double)h == a->h); /* the file promises that both are exact in float, too */
        got[SIGMA] = (double)sph_kernel_sigma(kernel, a->dim);
        got[W] = (double)sph_kernel_w(kernel, a->dim, r, h);
        got[DWDR] = (double)sph_kernel_dwdr(kernel, a->dim, r, h);
        got[F] = (double)sph_kernel_f(kernel, a->dim, r, h);
        got[D2WDR2] = (double)sph_kernel_d2wdr2(kernel, a->dim, r, h);
        got[DWDH] = (double)sph_kernel_dwdh(kernel, a->dim, r, h);

        for (quantity = 0; quantity < QUANTITIES; quantity++) {
            const double want = a->value[quantity];
            /* a value of 0 outside the support, and of the slope at the origin, is a promise, not an approximation */
            const int exact = quantity != SIGMA && (outside || (a->r == 0.0 && want == 0.0 && (quantity == DWDR || quantity == F)));
            /* F of a cusp grows like 1/q: a tolerance of its largest value would test nothing elsewhere */
            const int relative = quantity == F && sph_kernel_has_cusp(kernel);
            const double size = relative || quantity == SIGMA ? fabs(want) : scale[a->kernel][a->dim][quantity] / power_of_h(a->h, a->dim, quantity);
            const double deviation = fabs(got[quantity] - want), allowed = exact ? 0.0 : (quantity == SIGMA ? TOLERANCE_SIGMA : TOLERANCE) * epsilon * size;
            if (outside && quantity != SIGMA) CHECK(want == 0.0);
            if (!check_count(deviation <= allowed))
                fprintf(stderr, "%s:%d: %s of %s, dim %d, h %g, r %g: %.17g, should be %.17g, off by %.3g, allowed %.3g\n", path, a->line,
                        quantity_name[quantity], sph_kernel_name(kernel), a->dim, a->h, a->r, got[quantity], want, deviation, allowed);
            if (size > 0.0 && !(deviation / (epsilon * size) <= worst[quantity])) {
                worst[quantity] = deviation / (epsilon * size);
                worst_line[quantity] = a->line;
            }
        }
    }
    if (getenv("KNOWN_ANSWERS_VERBOSE"))
        for (quantity = 0; quantity < QUANTITIES; quantity++)
            printf("%-7s off by at most %.2f epsilon, in line %d\n", quantity_name[quantity], worst[quantity], worst_line[quantity]);
    return check_report("test_known_answers");
}
