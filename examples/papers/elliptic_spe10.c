/* SPDX-License-Identifier: MIT
 *
 * elliptic_spe10 - section 5.3 and figures 9 to 12 of Lukyanov & Vuik 2020: pressure in a heterogeneous medium, 60 x 60 cells of SPE10's layer 85 and 60 x 60 x 60 cells of its top, unit pressure drop along
 * the second axis and nothing through the other faces; M-SPH and Schwaiger's scheme against two-point fluxes, and what they cost GMRES.
 *
 *     elliptic_spe10 [-perm spe_perm.dat] [-layer FILE] [-block FILE] [-side N] [-out DIR] [-figures DIR] [-full]
 *
 * -perm names the data set as it is published (all of Kx, Ky, Kz), -layer and -block files of Kx alone: 60 x 220 numbers as text, 60^3 float32. Without them the run takes made-up fields of
 * the same kind, and says so: what the paper prints cannot be judged then. The data set is described by Christie & Blunt 2001, SPE Reservoir Eval. Eng. 4, 308; the SPE offers it for download.
 *
 * With PETSc (-DHAVE_PETSC=1; make reproduce PETSC=2: on two ranks) the systems in 3D are solved by its multigrid, too, beside GMRES with ILU(0).
 *
 * Particles are the cells' centres (unit cells, as the paper's pictures suggest) and the centres of the outer faces, which have the permeability of their cell. u = 0 on j = 1, u = 1 on j = 60.
 */
#include "elliptic_reference.h"

#include "elliptic_schwaiger.h"
#include "elliptic_system.h"

#include "../common/options.h"
#include "../common/progress.h"
#include "../common/report.h"
#include "../common/sparse_petsc.h"

enum { HISTORY = 400, FULL_HISTORY = 1000, RESTART = 50 }; /* iterations: FULL_HISTORY is 2 GB in 3D */

typedef struct problem {
    int dim, cells;
    elliptic_field field;
    cloud c;
    double *tpfa;     /* the reference */
    double *k[3];     /* of the particles */
    const char *name; /* of the medium */
    int real;         /* SPE10 itself */
} problem;

/* ---- particles and matrices ---- */

/* Cells first, then the faces of the low and the high end of each axis. */
static void particles(problem *p)
{
    const int *const n = p->field.n;
    int i, a, end, at = p->cells, faces = 0;
    for (a = 0; a < p->dim; a++) faces += 2 * (p->cells / n[a]);
    cloud_size(&p->c, p->dim, p->cells + faces);
    p->c.dx = 1;
    for (a = 0; a < 3; a++) {
        p->k[a] = elliptic_vector(p->c.n);
        p->c.low[a] = 0;
        p->c.high[a] = n[a];
    }
    for (i = 0; i < p->cells; i++) {
        const int at_cell[3] = {i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
        for (a = 0; a < p->dim; a++) cloud_axis(&p->c, a)[i] = at_cell[a] + 0.5;
        for (a = 0; a < 3; a++) p->k[a][i] = p->field.k[a][i];
    }
    for (a = 0; a < p->dim; a++)
        for (end = 0; end < 2; end++)
            for (i = 0; i < p->cells; i++) {
                const int at_cell[3] = {i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
                int b;
                if (at_cell[a] != (end ? n[a] - 1 : 0)) continue;
                for (b = 0; b < p->dim; b++) cloud_axis(&p->c, b)[at] = at_cell[b] + 0.5;
                cloud_axis(&p->c, a)[at] = end ? n[a] : 0;
                for (b = 0; b < 3; b++) p->k[b][at] = p->field.k[b][i];
                at++;
            }
    for (i = 0; i < p->c.n; i++) {
        p->c.V[i] = 1;
        p->c.m[i] = p->k[0][i];
    }
    cloud_depths(&p->c);
}

static void anisotropic(problem *p)
{
    const sph_cloud all = cloud_all(&p->c);
    const sph_diagonal M = {sph_scalars_array(p->k[0]), sph_scalars_array(p->k[1]),
                            sph_scalars_array(p->k[2])};
    const sph_rows_out out = {.row = p->c.row, .diagonal = p->c.diagonal};
    expect(WITH_DIM_2_3(sph_elliptic_rows_anisotropic, ELLIPTIC_KERNEL, p->dim, all, M, out));
}

enum { ANISOTROPIC = SCHEMES };

/* A and b, and where it is not null A and b before the rows are scaled to a diagonal of 1. Schwaiger's rows are those of elliptic_schwaiger.h; *apart: how far from M-SPH's. Returns the
   seconds of CPU that the rows took. */
static double matrix(problem *p, int scheme, int mean, sparse *A, double *b, sparse *unscaled, double *b_unscaled, double *apart)
{
    cloud *const c = &p->c;
    const clock_t begin = clock();
    unsigned char *const dirichlet = (unsigned char *)need(NULL, (size_t)c->n, 1);
    sph_elliptic_options o = {0};
    double seconds;
    int i;
    o.mean = mean;
    for (i = 0; i < c->n; i++) {
        dirichlet[i] = i >= p->cells && (c->y[i] == c->low[1] || c->y[i] == c->high[1]);
        b[i] = i >= p->cells && c->y[i] == c->high[1];
    }
    if (scheme != ANISOTROPIC) cloud_rows(c, scheme, o);
    else anisotropic(p);
    if (scheme == SCHEME_S) *apart = schwaiger_rows(c, p->cells, SPH_GRADIENT_DIFFUSE);
    cloud_box_conditions(c, p->cells, dirichlet);
    seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    if (unscaled) {
        cloud_matrix_unscaled(c, unscaled);
        memcpy(b_unscaled, b, (size_t)c->n * sizeof *b);
    }
    cloud_matrix(c, A, b);
    free(dirichlet);
    return seconds;
}

static elliptic_box box_of(const problem *p)
{
    elliptic_box box;
    int a;
    memset(&box, 0, sizeof box);
    for (a = 0; a < 3; a++) {
        box.n[a] = p->field.n[a];
        box.size[a] = 1;
        box.k[a] = p->field.k[a];
    }
    box.side[1][0].dirichlet = box.side[1][1].dirichlet = 1;
    box.side[1][1].value = 1;
    return box;
}

/* ---- solving ---- */

static void watch(void *context, int iteration, double residual)
{
    (void)residual;
    progress_update((progress *)context, fmin(0.99, iteration / 400.0));
}
static sparse_result solve(const sparse *A, const double *b, double *u, sparse_method method,
                           double tolerance, int restart, int most, double *history)
{
    sparse_options o = sparse_defaults();
    sparse_preconditioner P;
    sparse_result r;
    progress bar;
    int i;
    for (i = 0; i < A->n; i++) u[i] = 0;
    o.tolerance = tolerance;
    o.max_iterations = most;
    o.restart = restart;
    o.history = history;
    o.monitor = watch;
    o.context = &bar;
    elliptic_made(sparse_preconditioner_make(&P, method, A), "preconditioner");
    progress_begin(&bar, "GMRES", 0);
    r = sparse_gmres(A, &P, b, u, &o);
    progress_end(&bar);
    sparse_preconditioner_free(&P);
    return r;
}
static void must(sparse_result r)
{
    if (r.converged) return;
    fprintf(stderr, "elliptic_spe10: %s after %d iterations, residual %.2g\n", sparse_status_text(r.status),
            r.iterations, r.residual);
    exit(1);
}

/* ---- what is compared ---- */

typedef struct errors {
    double true_95, printed, largest, least_u, most_u;
} errors;
static errors errors_of(const problem *p)
{
    errors e = {0, 0, 0, HUGE_VAL, -HUGE_VAL};
    int i;
    e.true_95 = elliptic_relative_error(p->cells, p->tpfa, p->c.u);
    e.printed = elliptic_printed_error(e.true_95, p->field.n[0]);
    for (i = 0; i < p->cells; i++) {
        e.largest = fmax(e.largest, fabs(p->c.u[i] - p->tpfa[i]) / fabs(p->tpfa[i]));
        e.least_u = fmin(e.least_u, p->c.u[i]);
        e.most_u = fmax(e.most_u, p->c.u[i]);
    }
    return e;
}

static void compare(report *r, const problem *p, const char *what, int bounded)
{
    const errors e = errors_of(p);
    const char *const item = p->dim == 2 ? "Fig. 10, 2D" : "Fig. 10, 3D";
    char setting[128], measured[64];
    snprintf(setting, sizeof setting, "%s, %s", p->name, what);
    snprintf(measured, sizeof measured, "[%.3g, 1 - %.3g]", e.least_u, 1 - e.most_u);
    if (bounded)
        report_claim(r, item, setting, "range of u", "", measured, "0 <= u <= 1",
                     e.least_u >= -1e-9 && e.most_u <= 1 + 1e-9);
    else report_row(r, item, setting, "range of u", NULL, measured, NULL, NULL, REPORT_INFO);
    report_info(r, item, setting, "true (95) against TPFA, %", 100 * e.true_95);
    report_info(r, item, setting, "largest relative error of a cell, %", 100 * e.largest);
    report_not_reproduced(
        r, item, setting, "error in the tables' metric, 100/N (95)", p->dim == 2 ? 0.06 : 0.3, e.printed,
        p->real ? "norm and mean of mobilities unsaid; of the size of the tables' metric only"
                : "a made-up field");
}

static void map(const char *folder, const char *name, const problem *p, int layer)
{
    const int *const n = p->field.n;
    FILE *const file = figure_open(folder, name);
    int i;
    fprintf(file, "i,j,log10_k,u,relative_error\n");
    for (i = layer * n[0] * n[1]; i < (layer + 1) * n[0] * n[1]; i++) {
        fprintf(file, "%d,%d,%.5g,%.6g,%.5g\n", i % n[0] + 1, i / n[0] % n[1] + 1, log10(p->field.k[0][i]),
                p->c.u[i], fabs(p->c.u[i] - p->tpfa[i]) / fabs(p->tpfa[i]));
    }
    figure_close(file);
}

/* A matrix as it is assembled, and with its rows scaled to a diagonal of 1 */
typedef struct matrices {
    sparse plain, scaled;
    double *b_plain, *b;
} matrices;
static void matrices_free(matrices *m)
{
    sparse_free(&m->plain);
    sparse_free(&m->scaled);
    free(m->b_plain);
    free(m->b);
}

#if HAVE_PETSC
/* The same system by PETSc, on all ranks that there are. */
static void by_petsc(report *r, const problem *p, const char *setting, const matrices *m)
{
    double *const u = elliptic_vector(p->c.n), most = 0;
    const clock_t begin = clock();
    sparse_options o = sparse_defaults();
    sparse_result s;
    char text[192];
    int i, ranks;
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
    o.tolerance = 1e-9;
    o.restart = RESTART;
    o.max_iterations = 200;
    s = sparse_petsc(&m->scaled, NULL, m->b, u, &o);
    must(s);
    for (i = 0; i < p->c.n; i++) most = fmax(most, fabs(u[i] - p->c.u[i]));
    snprintf(text, sizeof text, "%s, PETSc on %d", setting, ranks);
    /* both to 1e-9 of the right-hand side: u itself differs by more, the more the larger the contrast is */
    report_info(r, "cost", text, "largest difference of u, which is 0 to 1, from GMRES + ILU(0)", most);
    report_range(report_beside(r, REPORT_THEORY), "PETSc", text, "its true error (95) against TPFA by that of GMRES + ILU(0)", 1,
                 elliptic_relative_error(p->cells, p->tpfa, u) / elliptic_relative_error(p->cells, p->tpfa, p->c.u), 0.999, 1.001);
    report_info(r, "cost", text, "GMRES + BoomerAMG to 1e-9: iterations", s.iterations);
    report_info(r, "cost", text, "GMRES + BoomerAMG: seconds of CPU of the first rank", (double)(clock() - begin) / CLOCKS_PER_SEC);
    free(u);
}
#endif

/* Figures 11, 12: residuals of GMRES without restarts for two matrices and three ways to precondition: none at all, the rows scaled (which is Jacobi from the left), and ILU(0) of these. */
static void histories(report *r, const char *folder, problem *p, const matrices *tpfa, const matrices *msph, int most)
{
    static const char *const way_name[] = {"no preconditioner", "rows scaled to a diagonal of 1 (Jacobi)", "ILU(0), rows scaled"};
    double *history[6], *const u = elliptic_vector(p->c.n);
    int reached[6], way, which, i;
    char name[64], setting[128], text[64];
    const char *const item = p->dim == 2 ? "Fig. 11" : "Fig. 12";
    FILE *file;
    for (which = 0; which < 2; which++)
        for (way = 0; way < 3; way++) {
            const matrices *const m = which ? msph : tpfa;
            const int k = 3 * which + way;
            sparse_result s;
            int six;
            history[k] = elliptic_vector(most + 1);
            s = solve(way ? &m->scaled : &m->plain, way ? m->b : m->b_plain, u, way == 2 ? SPARSE_ILU0 : SPARSE_NONE, 1e-10, 0, most,
                      history[k]);
            reached[k] = s.iterations;
            for (six = 0; six < s.iterations && history[k][six] > 1e-6; six++) {}
            snprintf(setting, sizeof setting, "%s, %s, %s", p->name, which ? "M-SPH = Schwaiger" : "TPFA", way_name[way]);
            if (history[k][six] <= 1e-6) snprintf(text, sizeof text, "%d", six);
            else snprintf(text, sizeof text, "> %d (%.1e there)", s.iterations, history[k][s.iterations]);
            report_row(r, item, setting, "iterations of full GMRES to 1e-6", NULL, text, NULL, NULL,
                       REPORT_INFO);
        }
    snprintf(name, sizeof name, "elliptic_fig%d_%s", p->dim == 2 ? 11 : 12, p->name);
    for (i = 0; name[i]; i++)
        if (name[i] == ' ') name[i] = '_';
    file = figure_open(folder, name);
    fprintf(file, "iteration,tpfa_none,tpfa_jacobi,tpfa_ilu0,msph_none,msph_jacobi,msph_ilu0\n");
    for (i = 0; i <= most; i++) {
        fprintf(file, "%d", i);
        for (which = 0; which < 6; which++)
            if (i <= reached[which]) fprintf(file, ",%.4g", history[which][i]);
            else fprintf(file, ",");
        fprintf(file, "\n");
    }
    figure_close(file);
    for (which = 0; which < 6; which++) free(history[which]);
    free(u);
}

/* Schwaiger's matrix from (52) as printed beside M-SPH's: rows, and in 2D condition numbers, that of TPFA, too. */
static void schwaiger(report *r, problem *p, const sparse *tpfa, const sparse *msph)
{
    static const char *const name[] = {"TPFA", "M-SPH", "Schwaiger"};
    double *const b = elliptic_vector(p->c.n), apart = HUGE_VAL, condition[3];
    const sparse *each[3];
    char text[64], setting[96];
    sparse S;
    int k;
    matrix(p, SCHEME_S, SPH_MOBILITY_ARITHMETIC, &S, b, NULL, NULL, &apart);
    report_range(report_beside(r, REPORT_THEORY), "identity", p->name, "largest difference of Schwaiger's rows and M-SPH's, of the largest entry", 0, apart, 0, 1e-10);
    each[0] = tpfa;
    each[1] = msph;
    each[2] = &S;
    for (k = 0; k < 3 && p->dim == 2; k++) {
        sparse_options o = sparse_defaults();
        sparse_condition a;
        o.tolerance = 1e-6;
        o.restart = 0;
        o.max_iterations = 1000;
        a = sparse_condition_estimate(each[k], &o);
        condition[k] = a.converged ? a.condition : (double)NAN;
        snprintf(setting, sizeof setting, "%s, %s", p->name, name[k]);
        report_info(r, "Fig. 11", setting, "condition estimate (1-norm), rows scaled", condition[k]);
    }
    if (p->dim == 2) {
        snprintf(text, sizeof text, "%.6g and %.6g", condition[1], condition[2]);
        report_claim(r, "Fig. 11", p->name, "condition numbers of M-SPH and Schwaiger's scheme", "similar", text,
                     "within 1 %", fabs(condition[2] / condition[1] - 1) <= 0.01);
    }
    sparse_free(&S);
    free(b);
}

static void two_points(const problem *p, const elliptic_box *box, matrices *m)
{
    m->b_plain = elliptic_vector(p->c.n);
    m->b = elliptic_vector(p->c.n);
    elliptic_made(elliptic_tpfa(box, &m->plain, m->b_plain), "matrix of two-point fluxes");
    elliptic_made(elliptic_tpfa(box, &m->scaled, m->b), "matrix of two-point fluxes");
    elliptic_made(sparse_scale_rows(&m->scaled, m->b), "scaled matrix of two-point fluxes");
}
static double msph_of(problem *p, int scheme, int mean, matrices *m)
{
    m->b_plain = elliptic_vector(p->c.n);
    m->b = elliptic_vector(p->c.n);
    return matrix(p, scheme, mean, &m->scaled, m->b, &m->plain, m->b_plain, NULL);
}

static void run(report *r, problem *p, const char *figures, int full)
{
    static const struct {
        double f;
        int mean;
        const char *what;
    } variants[] = {
        {0.5005, SPH_MOBILITY_ARITHMETIC, "f = 0.5005, arithmetic"},
        {0.5005, SPH_MOBILITY_HARMONIC, "f = 0.5005, harmonic"},
        {1.001, SPH_MOBILITY_HARMONIC, "f = 1.001, harmonic"},
        {1.001, SPH_MOBILITY_ARITHMETIC, "f = 1.001, arithmetic"}}; /* the last is what is drawn */
    const elliptic_box box = box_of(p);
    const int anisotropic = p->field.k[2] != p->field.k[0] && p->dim == 3;
    matrices tpfa, msph;
    sparse_result s;
    char title[384], setting[128], name[64];
    clock_t begin;
    size_t v;
    p->cells = elliptic_cells(p->field.n);
    snprintf(title, sizeof title, "%dD, %d x %d x %d cells: %s", p->dim, p->field.n[0], p->field.n[1],
             p->field.n[2], p->field.source);
    report_section(r, title);
    report_info(r, "medium", p->name, "largest / smallest permeability", elliptic_contrast(&p->field));
    particles(p);
    p->tpfa = elliptic_vector(p->c.n);
    {
        elliptic_box isotropic = box;
        isotropic.k[1] = isotropic.k[2] = isotropic.k[0];
        two_points(p, &isotropic, &tpfa);
    }
    must(solve(&tpfa.scaled, tpfa.b, p->tpfa, SPARSE_ILU0, 1e-9, p->dim == 2 ? 0 : RESTART, 6000, NULL));
    for (v = 0; v < sizeof variants / sizeof *variants; v++) {
        const int last = v + 1 == sizeof variants / sizeof *variants;
        double assembly;
        if (p->dim == 3 && !full && !last) continue;
        cloud_neighbours(&p->c, variants[v].f);
        assembly = msph_of(p, SCHEME_M, variants[v].mean, &msph);
        begin = clock();
        s = solve(&msph.scaled, msph.b, p->c.u, SPARSE_ILU0, 1e-9, p->dim == 2 ? 0 : RESTART, 6000, NULL);
        must(s);
        compare(r, p, variants[v].what, 1);
        snprintf(setting, sizeof setting, "%s, %s", p->name, variants[v].what);
        report_info(r, "cost", setting, "rows, microseconds of CPU per particle", 1e6 * assembly / p->c.n);
        report_info(r, "cost", setting, "GMRES + ILU(0) to 1e-9: iterations", s.iterations);
        report_info(r, "cost", setting, "GMRES + ILU(0): seconds of CPU",
                    (double)(clock() - begin) / CLOCKS_PER_SEC);
#if HAVE_PETSC
        if (p->dim == 3) by_petsc(r, p, setting, &msph);
#endif
        if (last) {
            snprintf(name, sizeof name, "elliptic_fig10_%dd_%s", p->dim, p->real ? "spe10" : p->name);
            for (begin = 0; name[begin]; begin++)
                if (name[begin] == ' ') name[begin] = '_';
            map(figures, name, p, p->dim == 2 ? 0 : p->field.n[2] / 2);
            histories(r, figures, p, &tpfa, &msph,
                      full          ? FULL_HISTORY
                      : p->dim == 2 ? HISTORY
                                    : HISTORY / 8);
            schwaiger(r, p, &tpfa.scaled, &msph.scaled);
        }
        matrices_free(&msph);
    }
    if (anisotropic) { /* Kz of its own: the consistent operator, against TPFA with it */
        matrices_free(&tpfa);
        two_points(p, &box, &tpfa);
        must(solve(&tpfa.scaled, tpfa.b, p->tpfa, SPARSE_ILU0, 1e-9, RESTART, 6000, NULL));
        cloud_neighbours(&p->c, 1.001);
        msph_of(p, ANISOTROPIC, SPH_MOBILITY_ARITHMETIC, &msph);
        s = solve(&msph.scaled, msph.b, p->c.u, SPARSE_ILU0, 1e-9, RESTART, 6000, NULL);
        snprintf(setting, sizeof setting, "%s, Kz != Kx, %s", p->name, sparse_status_text(s.status));
        report_info(r, "anisotropic", setting, "residual", s.residual);
        if (s.converged) compare(r, p, "Kz != Kx, consistent rows, f = 1.001", 0);
        matrices_free(&msph);
    }
    matrices_free(&tpfa);
    free(p->tpfa);
    for (v = 0; v < 3; v++) free(p->k[v]);
    cloud_close(&p->c);
    elliptic_field_free(&p->field);
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".", *perm = NULL, *layer = NULL, *block = NULL;
    int full = 0, side = 0, dim, kind;
    const option_spec specs[] = {
        {"perm", "spe_perm.dat: Kx, Ky, Kz of the whole model", OPTION_TEXT, &perm, 0, 0},
        {"layer", "text of 60 x 220 numbers: Kx of layer 85", OPTION_TEXT, &layer, 0, 0},
        {"block", "60^3 float32: Kx of i, j, k = 1 to 60", OPTION_TEXT, &block, 0, 0},
        {"side", "cells along a side of the made-up block in 3D (default: 40, or 60 with -full)", OPTION_INT,
         &side, 12, 100},
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "all variants in 3D, longer histories", OPTION_FLAG, &full, 0, 0},
    };
    static report r;
    char message[ELLIPTIC_MESSAGE] = "";
#if HAVE_PETSC
    int none = 0;
    if (PetscInitialize(&none, NULL, NULL, NULL)) return 2; /* its own options come by the environment */
    if (sparse_petsc_helped()) return PetscFinalize() != 0;
#endif
    options_parse(argc, argv,
                  "SPE10 and figures 9 to 12 of the elliptic paper: M-SPH and Schwaiger's scheme against "
                  "two-point fluxes.",
                  specs, sizeof specs / sizeof *specs);
    if (side == 0) side = full ? 60 : 40;
    report_open(&r, "elliptic_spe10", out);
    figure_folder(figures, "elliptic_spe10");
    for (dim = 2; dim <= 3; dim++) {
        const char *const path = dim == 2 ? (layer ? layer : perm) : block ? block : perm;
        for (kind = 0; kind < (path ? 1 : 2); kind++) {
            problem p;
            memset(&p, 0, sizeof p);
            p.dim = dim;
            p.real = path != NULL;
            p.name = path                         ? "SPE10"
                     : kind == ELLIPTIC_LOGNORMAL ? "lognormal surrogate"
                                                  : "channel surrogate";
            if (path ? elliptic_spe10_read(path, dim, &p.field, message)
                     : elliptic_surrogate_make((elliptic_surrogate)kind, dim == 2 ? 60 : side,
                                               dim == 2 ? 60 : side, dim == 2 ? 1 : side, 85, &p.field,
                                               message)) {
                fprintf(stderr, "elliptic_spe10: %s\n", message);
                return 2;
            }
            if (!path)
                printf("\nNo file of SPE10 was named (-perm, -layer, -block): a made-up medium instead.\n");
            run(&r, &p, figures, full);
        }
    }
#if HAVE_PETSC
    sparse_petsc_done();
    if (PetscFinalize()) return 2;
#endif
    return report_close(&r) ? 1 : 0;
}
