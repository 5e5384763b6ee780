/* SPDX-License-Identifier: MIT
 *
 * column.h - a column of water of a x 2a that collapses on a dry bed: experiments, the front of a run beside them, and the lines of a figure of both.
 */
#ifndef COLUMN_H
#define COLUMN_H

#include <math.h>
#include <stdio.h>

#include "report.h"
#include "statistics.h"

/* How far water has come, at times about `every` apart. */
enum { FRONT_SAMPLES = 400 };
typedef struct front_record {
    double every, t[FRONT_SAMPLES], x[FRONT_SAMPLES];
    int count;
} front_record;

/* whether the next one is due */
static inline int front_due(const front_record *r, double t) { return r->count < FRONT_SAMPLES && t > r->count * r->every - 1e-9; }
static inline void front_add(front_record *r, double t, double x)
{
    r->t[r->count] = t;
    r->x[r->count++] = x;
}
/* between samples; NaN after the last */
static inline double front_at(const front_record *r, double t)
{
    int k = 1;
    if (r->count < 2) return (double)NAN;
    while (k < r->count - 1 && r->t[k] < t) k++;
    if (t > r->t[k] + 0.5 * r->every) return (double)NAN;
    return r->x[k - 1] + (r->x[k] - r->x[k - 1]) * (t - r->t[k - 1]) / (r->t[k] - r->t[k - 1]);
}

/* T = t sqrt(2 g / a), Z = x / a. Martin & Moyce 1952, Phil. Trans. R. Soc. Lond. A 244, 312, table 2 (a = 2.25 in, n^2 = 2); Koshizuka & Oka 1996, Nucl. Sci. Eng. 123, 421 (a = 0.146 m), as digitised for PySPH's
   examples (db_exp_data.py). */
enum { MARTIN = 15, KOSHIZUKA = 9 };
static const double martin_T[MARTIN] = {0.41, 0.84, 1.19, 1.43, 1.63, 1.83, 1.98, 2.20, 2.32, 2.51, 2.65, 2.83, 2.98, 3.11, 3.33};
static const double martin_Z[MARTIN] = {1.11, 1.22, 1.44, 1.67, 1.89, 2.11, 2.33, 2.56, 2.78, 3.00, 3.22, 3.44, 3.67, 3.89, 4.11};
static const double koshizuka_T[KOSHIZUKA] = {0, 0.381, 0.769, 1.153, 1.537, 1.935, 2.323, 2.719, 3.096};
static const double koshizuka_Z[KOSHIZUKA] = {1, 1.111, 1.252, 1.505, 1.892, 2.241, 2.615, 3.003, 3.624};

/* a of Martin & Moyce, and T of a second */
static const double column_a = 0.05715, column_gravity = 9.81;
static inline double column_T(double t) { return t * sqrt(2 * column_gravity / column_a); }

/* largest and mean of Z / Z_experiment - 1 */
static inline void column_compare(const front_record *f, const double *T, const double *Z, int count, double *worst, double *mean)
{
    int k;
    *worst = *mean = 0;
    for (k = 0; k < count; k++) {
        const double off = front_at(f, T[k] / column_T(1)) / column_a / Z[k] - 1;
        *mean += off / count;
        if (fabs(off) > fabs(*worst)) *worst = off;
    }
}

/* The front of a run until T = 3.4, beside both; judged: its speed. */
static inline void column_rows(report *r, const char *run, const front_record *f, int judged)
{
    static const char *const quantity = "dZ/dT from T = 1.83 to 3.33 (Martin & Moyce 1952)";
    double worst, mean, speed, measured, t[MARTIN], z[MARTIN];
    int k;
    for (k = 0; k < MARTIN; k++) {
        t[k] = martin_T[k];
        z[k] = front_at(f, t[k] / column_T(1)) / column_a;
    }
    measured = statistics_slope(t + 5, martin_Z + 5, MARTIN - 5);
    speed = statistics_slope(t + 5, z + 5, MARTIN - 5);
    if (judged) report_relative(report_beside(r, REPORT_OTHERS), "column", run, quantity, measured, speed, 0.15);
    else report_number_row(report_beside(r, REPORT_OTHERS), "column", run, quantity, measured, speed, NULL, NULL, REPORT_INFO);
    column_compare(f, martin_T, martin_Z, MARTIN, &worst, &mean);
    report_info(r, "column", run, "mean of Z / Z of Martin & Moyce - 1", mean);
    report_info(r, "column", run, "largest of these", worst);
    column_compare(f, koshizuka_T, koshizuka_Z, KOSHIZUKA, &worst, &mean);
    report_info(r, "column", run, "mean of Z / Z of Koshizuka & Oka - 1", mean);
    report_info(r, "column", run, "largest of these", worst);
}

/* lines run,T,Z of a figure's data */
static inline void column_experiment_lines(FILE *to)
{
    int k;
    for (k = 0; k < MARTIN; k++) fprintf(to, "martin_moyce,%g,%g\n", martin_T[k], martin_Z[k]);
    for (k = 0; k < KOSHIZUKA; k++) fprintf(to, "koshizuka_oka,%g,%g\n", koshizuka_T[k], koshizuka_Z[k]);
}
static inline void column_lines(FILE *to, const char *run, const front_record *f)
{
    int k;
    for (k = 0; k < f->count; k++) fprintf(to, "%s,%.6g,%.6g\n", run, column_T(f->t[k]), f->x[k] / column_a);
}

#endif
