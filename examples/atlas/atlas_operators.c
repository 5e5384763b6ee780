/* SPDX-License-Identifier: MIT
 *
 * The atlas of operators: what each does on lattices, in disorder and at boundaries, measured by one program.
 * See README.md beside this file. The table of operators is in operators.h.
 */
#ifndef SPH_FN
/* not forced inline: kernel and dimension are known at run time only, and one copy of each function is enough */
#if defined(__GNUC__)
#define SPH_FN static __attribute__((unused))
#else
#define SPH_FN static inline
#endif
#endif
#include "../common/options.h"
#include "../common/report.h"
#include "figures.h"
#include "header.h"
#include "pages.h"

#define ATLAS_CALL(id, function, family, list, formula, source, note, expression) \
    static sph_index call_##id(sph_kernel k, int dim, const sample *s, double *const *in, double *const *out) \
    { \
        const views a = views_of(s, in, out); \
        (void)k; /* which collisions have not */ \
        return expression; \
    }
ATLAS_OPERATORS(ATLAS_CALL)
#define ATLAS_ROW(id, function, family, list, formula, source, note, expression) {#id, #function, family, list, formula, source, note, call_##id},
static const op all_operators[] = {ATLAS_OPERATORS(ATLAS_ROW)};
enum { OPERATORS = sizeof all_operators / sizeof all_operators[0] };
static op operators[OPERATORS]; /* those that are wanted */
static int wanted;

/* The first of each dimension is the one that claims are compared with, and that portraits are made at. */
static const config configs[] = {
    {2, SPH_WENDLAND_C2, 2.0},  {3, SPH_WENDLAND_C2, 1.6}, {2, SPH_WENDLAND_C2, 1.3},  {2, SPH_CUBIC_SPLINE, 1.2}, {2, SPH_CUBIC_SPLINE, 1.8},
    {2, SPH_QUINTIC_SPLINE, 1.0}, {2, SPH_QUINTIC_SPLINE, 1.4}, {3, SPH_WENDLAND_C2, 1.3}, {3, SPH_CUBIC_SPLINE, 1.2}, {3, SPH_CUBIC_SPLINE, 1.6},
    {3, SPH_QUINTIC_SPLINE, 1.0}, {3, SPH_QUINTIC_SPLINE, 1.2}};
enum { CONFIGS = sizeof configs / sizeof configs[0], QUICK_CONFIGS = 2 };

static result results[OPERATORS];
static errors at[OPERATORS][CONFIGS];

/* ---- numbers ---- */

static void failed_to_write(const char *path)
{
    fprintf(stderr, "atlas: cannot write %s: create the folder first\n", path);
    exit(2);
}
static void write_numbers(part_file csv, const char *figures, int configurations)
{
    fprintf(csv.to, "operator,dim,kernel,h_dx,cloud,region,spacing,error,worst\n");
    for (int o = 0; o < wanted; o++)
        for (int c = 0; c < configurations && operators[o].family < WITH_ERRORS; c++)
            for (int kind = 0; kind < SAMPLE_KINDS; kind++)
                for (int region = 0; region < REGIONS; region++)
                    for (int level = 0; level < LEVELS; level++)
                        fprintf(csv.to, "%s,%d,%s,%.2f,%s,%s,%.6f,%.4e,%.4e\n", operators[o].id, configs[c].dim, sph_kernel_name(configs[c].k), configs[c].h_dx, sample_kind_name(kind),
                                sample_region_name(region), level_spacing(level), at[o][c].rms[kind][region][level], at[o][c].worst[kind][region][level]);
    if (!part_file_close(&csv)) failed_to_write(csv.path);
    if (!part_file_open(&csv, figures, "atlas_transfer", "csv")) failed_to_write(csv.part);
    fprintf(csv.to, "operator,dim,direction,k_dx,real,imaginary\n");
    for (int o = 0; o < wanted; o++)
        for (int c = 0; c < 2 && operators[o].family < LINEAR; c++)
            for (int d = 0; d < 2; d++)
                for (int w = 0; w < WAVES; w++)
                    fprintf(csv.to, "%s,%d,%s,%.5f,%.6f,%.6f\n", operators[o].id, configs[c].dim, d ? "diagonal" : "axis", acos(-1.0) * (w + 1) / WAVES, results[o].of[c].transfer[d][w].re,
                            results[o].of[c].transfer[d][w].im);
    if (!part_file_close(&csv)) failed_to_write(csv.path);
    if (!part_file_open(&csv, figures, "atlas_figures", "csv")) failed_to_write(csv.part);
    fprintf(csv.to, "operator,dim,cloud,figure,value\n");
    for (int o = 0; o < wanted; o++)
        for (int c = 0; c < 2; c++)
            for (int f = 0; f < results[o].of[c].figure_count; f++)
                for (int kind = 0; kind < SAMPLE_KINDS; kind++) {
                    const figure *const at_cloud = &results[o].of[c].figures[f];
                    fprintf(csv.to, "%s,%d,%s,\"%s\",%.4g\n", operators[o].id, configs[c].dim, sample_kind_name(kind), at_cloud->name, at_cloud->value[kind]);
                }
    if (!part_file_close(&csv)) failed_to_write(csv.path);
}
/* The table of atlas_cost, if it has run. */
static void read_costs(const char *figures)
{
    char path[1024], line[256];
    for (int o = 0; o < wanted; o++)
        for (int d = 0; d < 2; d++) results[o].cost[d] = results[o].cost_ns[d] = (double)NAN;
    snprintf(path, sizeof path, "%s/atlas_costs.csv", figures);
    FILE *const csv = fopen(path, "rb");
    if (!csv) return;
    while (fgets(line, sizeof line, csv)) {
        char *const comma = strchr(line, ',');
        if (!comma) continue;
        *comma = '\0';
        for (int o = 0; o < wanted; o++)
            if (strcmp(line, operators[o].id) == 0) {
                const char *rest;
                const int dim = (int)number_of(comma + 1, &rest);
                if ((dim != 2 && dim != 3) || *rest != ',') continue;
                results[o].cost[dim - 2] = number_of(rest + 1, &rest);
                if (*rest == ',') results[o].cost_ns[dim - 2] = number_of(rest + 1, &rest);
            }
    }
    fclose(csv);
}

/* ---- claims ---- */

/* An order that was measured, as a whole number: inside lattices orders are even, because lattices are symmetric. */
static int is_order(double measured, int claimed, int lattice)
{
    if (!isfinite(measured)) return 0;
    return lattice && claimed == 0 ? measured > -0.5 && measured < 1.0 : fabs(measured - claimed) < 0.5;
}
static void judge(report *r, const header *h)
{
    for (int o = 0; o < wanted; o++) {
        const op *const q = &operators[o];
        claim *const c = &results[o].claim;
        char formula[512];
        char *const comment = header_comment(h, q->function);
        if (q->family < WITH_ERRORS) {
            *c = header_claim(h, q->function, family(q->family).word);
            report_row(report_beside(r, REPORT_THEORY), q->id, q->function, "what sph_ops.h claims", c->given ? c->text : "nothing is claimed", c->given > 0 ? "read" : "not understood", "a line 'Atlas: ...'", NULL,
                       c->given > 0 ? REPORT_MATCH : REPORT_DIFFERS);
        } else { /* what is kept, in one sentence */
            const portrait *const in_2d = &results[o].of[q->family == GRAVITY]; /* gravity is of 3D only */
            portrait both = results[o].of[1];
            both.momentum = fmax(both.momentum, in_2d->momentum);
            both.angular = fmax(both.angular, in_2d->angular);
            both.energy = fmax(both.energy, in_2d->energy);
            kept_text(q->family, &both, c->text);
            c->given = comment && strstr(comment, c->text) != NULL;
            report_row(report_beside(r, REPORT_THEORY), q->id, q->function, "what is kept", c->text, c->given ? "said" : "not what sph_ops.h says", "the same sentence", NULL, c->given ? REPORT_MATCH : REPORT_DIFFERS);
        }
        snprintf(formula, sizeof formula, "%s; %s", q->formula, q->source);
        for (char *part = strtok(formula, ";"); part; part = strtok(NULL, ";")) {
            while (*part == ' ') part++;
            if (!header_says(h, part)) report_row(report_beside(r, REPORT_THEORY), q->id, q->function, "formula and source", part, "not in sph_ops.h", "as in sph_ops.h", NULL, REPORT_DIFFERS);
        }
        const char *at_phrase = comment;
        for (int degree, where; comment && q->family < WITH_ERRORS && header_phrase(&at_phrase, &degree, &where);)
            for (int d = 0; d < 2; d++) { /* what is said in other words must not be more than is so */
                const portrait *const p = &results[o].of[d];
                const int measured = where ? p->exact_lattice : p->exact;
                if (degree > measured)
                    report_row(report_beside(r, REPORT_THEORY), q->id, q->function, "exact for, in the words of the comment", degree_text(degree), degree_text(measured), "not more", NULL, REPORT_DIFFERS);
            }
        free(comment);
        for (int d = 0; d < 2 && c->given > 0 && q->family < WITH_ERRORS; d++) {
            static const char *const where[3] = {"order inside lattices", "order in disorder", "order at boundaries"};
            const portrait *const p = &results[o].of[d];
            char setting[96], said[32], text[32];
            double order[3];
            snprintf(setting, sizeof setting, "%dD, %s, h = %.1f dx", configs[d].dim, sph_kernel_name(configs[d].k), configs[d].h_dx);
            report_row(report_beside(r, REPORT_THEORY), q->id, setting, "exact for", degree_text(c->exact), degree_text(p->exact), "the same", NULL, p->exact == c->exact ? REPORT_MATCH : REPORT_DIFFERS);
            report_row(report_beside(r, REPORT_THEORY), q->id, setting, "exact inside lattices for", degree_text(c->exact_lattice), degree_text(p->exact_lattice), "the same", NULL,
                       p->exact_lattice == c->exact_lattice ? REPORT_MATCH : REPORT_DIFFERS);
            measured_orders(&at[o][d], order);
            for (int k = 0; k < 3; k++) {
                snprintf(said, sizeof said, "%d", c->order[k]);
                report_row(report_beside(r, REPORT_THEORY), q->id, setting, where[k], said, order_text(text, order[k]), k ? "the nearest whole number" : "the nearest even number", NULL,
                           is_order(order[k], c->order[k], k == 0) ? REPORT_MATCH : REPORT_DIFFERS);
            }
        }
    }
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".", *headers = ".", *pages = "", *kept = "", *only = "";
    int full = 0, quiet = 0, mend = 0;
    report r;
    const option_spec specs[] = {
        {"out", "directory of the table of results", OPTION_TEXT, &out, 0, 0},
        {"figures", "directory of the measured numbers", OPTION_TEXT, &figures, 0, 0},
        {"headers", "directory of sph_ops.h, whose comments are read", OPTION_TEXT, &headers, 0, 0},
        {"pages", "directory of the pages; none are written without", OPTION_TEXT, &pages, 0, 0},
        {"kept", "directory of pages: only tells which of them say something else than the table and sph_ops.h do", OPTION_TEXT, &kept, 0, 0},
        {"mend", "with -kept: writes anew what operators' pages say beside their numbers", OPTION_FLAG, &mend, 0, 0},
        {"only", "operators whose names contain this", OPTION_TEXT, &only, 0, 0},
        {"full", "all kernels and lengths", OPTION_FLAG, &full, 0, 0},
        {"quiet", "no progress on stderr", OPTION_FLAG, &quiet, 0, 0},
    };
    options_parse(argc, argv, "The atlas: what each operator does, measured.", specs, (int)(sizeof specs / sizeof specs[0]));
    const int configurations = full ? CONFIGS : QUICK_CONFIGS, targets = full ? 100 : 40;
    const double steps = (double)configurations * SAMPLE_KINDS * LEVELS + 2.0 * 30.0;
    double step = 0.0;
    header h = header_read(headers);
    progress bar;
    part_file csv;
    for (int o = 0; o < (int)OPERATORS; o++)
        if (strstr(all_operators[o].id, only)) operators[wanted++] = all_operators[o];
    if (*kept) {
        const int stale = pages_stale(operators, wanted, &configs[0], &h, kept, mend);
        header_free(&h);
        printf("atlas: %d files in %s are out of date\n", stale, kept);
        return stale ? 1 : 0;
    }
    report_open(&r, "atlas_operators", out);
    if (!part_file_open(&csv, figures, "atlas_errors", "csv")) failed_to_write(csv.part);
    progress_begin(&bar, "atlas", quiet);
    for (int c = 0; c < configurations; c++) {
        for (int kind = 0; kind < SAMPLE_KINDS; kind++) {
            const sample_wish wish = {kind, targets, 0, kind == SAMPLE_RELAXED ? 0.3 : atlas_default_jitter, 3};
            sample s = sample_make(configs[c].k, configs[c].dim, configs[c].h_dx, wish);
            for (int level = 0; level < LEVELS; level++) {
                sample_zoom(&s, level_spacing(level));
                for (int o = 0; o < wanted; o++) measure_errors(&operators[o], &s, level, &at[o][c]);
                progress_update(&bar, (step += 1.0) / steps);
            }
            sample_free(&s);
        }
        if (c < 2) {
            measure_portraits(operators, wanted, &configs[c], targets, &results[0].of[c], sizeof results[0]);
            progress_update(&bar, (step += 20.0) / steps);
            for (int o = 0; o < wanted; o++) {
                measure_figures(&operators[o], &configs[c], &results[o].of[c]);
                progress_update(&bar, (step += 10.0 / wanted) / steps);
            }
        }
    }
    progress_end(&bar);
    read_costs(figures);
    write_numbers(csv, figures, configurations);
    judge(&r, &h);
    if (*pages) {
        for (int o = 0; o < wanted; o++) results[o].at = at[o];
        const atlas a = {operators, results, configs, wanted, configurations, full, &h, pages};
        pages_write(&a);
    }
    for (int o = 0; o < wanted; o++) {
        free(results[o].of[0].eigenvalue);
        free(results[o].of[1].eigenvalue);
    }
    header_free(&h);
    return report_close(&r) ? 1 : 0;
}
