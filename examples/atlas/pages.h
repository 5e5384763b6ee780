/* SPDX-License-Identifier: MIT
 *
 * pages.h - the pages of the atlas: index.html with a table of all operators, choose.html, and one page for each
 * operator. Plain files that load nothing from elsewhere; without scripts all is there but sorting and filters.
 *
 * What a page says without having measured it is written by functions named ..._words and ..._row: pages that are
 * kept are compared with them (pages_stale).
 */
#ifndef ATLAS_PAGES_H
#define ATLAS_PAGES_H

#include "../common/part_file.h"
#include "figures.h"
#include "header.h"
#include "mathml.h"
#include "svg.h"

typedef struct result {
    errors *at;     /* of each configuration */
    portrait of[2]; /* of the first two configurations, in 2D and 3D */
    claim claim;
    double cost[2], cost_ns[2]; /* in units of the density's; NaN: not measured */
} result;
typedef struct atlas {
    const op *operators;
    const result *results;
    const config *configs;
    int count, configurations, full;
    const header *says;
    const char *folder;
} atlas;

/* ---- pieces ---- */

static inline void html_text(FILE *to, const char *from, size_t length)
{
    for (size_t q = 0; q < length; q++)
        if (from[q] == '<') fputs("&lt;", to);
        else if (from[q] == '>') fputs("&gt;", to);
        else if (from[q] == '&') fputs("&amp;", to);
        else putc(from[q], to);
}
static inline part_file page_file(const atlas *a, const char *name, const char *ending)
{
    part_file page;
    if (!part_file_open(&page, a->folder, name, ending)) {
        fprintf(stderr, "atlas: cannot write %s: create the folder first\n", page.part);
        exit(2);
    }
    return page;
}
static inline void page_done(part_file *page)
{
    if (part_file_close(page)) return;
    fprintf(stderr, "atlas: %s could not be written: is the disk full?\n", page->path);
    exit(2);
}
static inline void head_words(FILE *to, const char *title)
{
    fprintf(to, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                     "<title>%s - atlas of sph.h</title>\n<link rel=\"stylesheet\" href=\"atlas.css\">\n</head>\n<body>\n"
                     "<nav aria-label=\"pages\"><a href=\"index.html\">All operators</a> <a href=\"choose.html\">Which one?</a> <a href=\"kernels.html\">Kernels</a></nav>\n<main>\n<h1>%s</h1>\n",
            title, title);
}
static inline part_file page_open(const atlas *a, const char *name, const char *title)
{
    const part_file page = page_file(a, name, "html");
    head_words(page.to, title);
    return page;
}
static inline void page_close(const atlas *a, part_file *page)
{
    fprintf(page->to, "</main>\n<footer><p>Written by examples/atlas of sph.h %d.%d.%d, a %s run. All figures are measured by it; what is said of an operator is read from sph_ops.h.</p></footer>\n</body>\n</html>\n",
            SPH_VERSION_MAJOR, SPH_VERSION_MINOR, SPH_VERSION_PATCH, a->full ? "full" : "quick");
    page_done(page);
}
/* An error: two digits; rounding is called 0. */
static inline const char *error_text(char text[32], double error)
{
    if (isnan(error)) return "-";
    if (error < 1e-11) return "0";
    snprintf(text, 32, error < 1e-3 || error >= 1e3 ? "%.1e" : "%.2g", error);
    return text;
}
static inline const char *order_text(char text[32], double order)
{
    if (isnan(order)) return "-";
    if (isinf(order)) return "exact";
    snprintf(text, 32, "%.1f", order + 0.0 == 0.0 ? 0.0 : fabs(order) < 0.05 ? 0.0 : order);
    return text;
}
/* A cell whose sorting goes by the number. */
static inline void cell(FILE *to, double value, const char *text)
{
    if (isnan(value)) fprintf(to, "<td data-v=\"1e300\">%s</td>", text);
    else fprintf(to, "<td data-v=\"%.6g\">%s</td>", isinf(value) ? 1e200 : value, text);
}
static inline const char *yes_no(int yes) { return yes ? "yes" : "no"; }
static inline int is_laplacian(const op *o) { return o->family == LAPLACIAN || o->family == ELLIPTIC; }
static inline int has_rows(const op *o) { return is_laplacian(o) || o->family == VALUE; }
/* The portrait that tables of all operators show: of 2D, if the operator is not one of 3D only. */
static inline const portrait *shown(const op *o, const result *r) { return &r->of[o->family == GRAVITY]; }
static inline int has_sum(const op *o) { return family(o->family).powers > 0 || o->family > ADAPTIVE; }
static inline double worse(double a, double b) { return isnan(a) ? b : isnan(b) ? a : fmax(a, b); }

/* What claims are compared with: orders inside lattices, in disorder (the least of three clouds), at boundaries. */
static inline void measured_orders(const errors *e, double *order)
{
    order[0] = order_of(e->rms[SAMPLE_LATTICE][REGION_INSIDE]);
    order[1] = fmin(order_of(e->rms[SAMPLE_JITTER][REGION_INSIDE]), fmin(order_of(e->rms[SAMPLE_POISSON][REGION_INSIDE]), order_of(e->rms[SAMPLE_RANDOM][REGION_INSIDE])));
    order[2] = fmin(order_of(e->rms[SAMPLE_LATTICE][REGION_WALL]), order_of(e->rms[SAMPLE_LATTICE][REGION_SURFACE]));
}

/* ---- index.html ---- */

static inline void style_words(FILE *to)
{
    fputs(":root{color-scheme:light dark;--ground:#fff;--ink:#1a1a1a;--faint:#5b6066;--line:#d5d9de;--box:#f4f6f8;--link:#0b5cad;--c0:#0b5cad;--c1:#c2410c;--c2:#15803d;--c3:#9333ea;--c4:#a16207;--c5:#be123c;--c6:#0e7490;--c7:#4d4d4d}\n"
          "@media(prefers-color-scheme:dark){:root{--ground:#15181c;--ink:#e8eaed;--faint:#a3aab2;--line:#3a4149;--box:#1f242a;--link:#7db7ff;--c0:#7db7ff;--c1:#ff9a5c;--c2:#5fd68a;--c3:#cf9bff;--c4:#f0c24b;--c5:#ff8096;--c6:#5ad1e6;--c7:#c0c0c0}}\n"
          "*{box-sizing:border-box}body{margin:0 auto;padding:1rem;max-width:110rem;background:var(--ground);color:var(--ink);font:16px/1.5 system-ui,sans-serif}\n"
          "a{color:var(--link)}nav a{margin-right:1.2rem}h1{font-size:1.6rem;overflow-wrap:anywhere}h2{font-size:1.25rem;margin-top:2rem}p,li,dd{max-width:70ch}\n"
          ".scroll{overflow-x:auto;max-width:100%}table{border-collapse:collapse;font-size:.9rem}caption{text-align:left;padding:.3rem 0;color:var(--faint)}th,td{border-bottom:1px solid var(--line);padding:.25rem .6rem;text-align:right;white-space:nowrap}\n"
          "th:first-child,td:first-child{text-align:left}th.words{white-space:normal;min-width:14rem;font-weight:normal}.sort th:first-child{position:sticky;left:0;background:var(--box)}thead th{background:var(--box);vertical-align:bottom}th button{font:inherit;font-weight:bold;color:inherit;background:none;border:0;padding:.3rem 0;cursor:pointer;text-align:inherit;white-space:normal}\n"
          "th[aria-sort=ascending] button::after{content:' \\25B2'}th[aria-sort=descending] button::after{content:' \\25BC'}button:focus-visible,a:focus-visible,input:focus-visible,select:focus-visible{outline:3px solid var(--link);outline-offset:2px}\n"
          "tbody tr:hover{background:var(--box)}td.left{text-align:left}td.note{white-space:normal;min-width:18rem;text-align:left}form{display:flex;flex-wrap:wrap;gap:.6rem 1.5rem;margin:1rem 0}label{display:inline-block;max-width:100%}input,select{max-width:100%;font:inherit;padding:.2rem .4rem;background:var(--ground);color:var(--ink);border:1px solid var(--faint);border-radius:3px}\n"
          "pre{background:var(--box);padding:.8rem;overflow-x:auto;font-size:.85rem}.equation{overflow-x:auto;padding:.5rem;background:var(--box)}math{font-size:1.2rem}\n"
          ".plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,27rem),1fr));gap:1rem}figure{margin:0;border:1px solid var(--line);padding:.5rem}figcaption{font-weight:bold}figure>svg{width:100%;height:auto}\n"
          ".legend{list-style:none;margin:0;padding:0;display:flex;flex-wrap:wrap;gap:0 1rem;font-size:.85rem}.legend svg{vertical-align:middle}.p{stroke:var(--c0);stroke-width:4;stroke-linecap:round;fill:none}.grid{stroke:var(--line);fill:none}.t{fill:var(--ink);font-size:13px}\n"
          "summary{cursor:pointer;margin:.8rem 0;color:var(--link)}dt{font-weight:bold;margin-top:.4rem}dd{margin:0 0 0 1rem}footer{margin-top:3rem;color:var(--faint);font-size:.85rem}.no{color:var(--faint)}\n",
          to);
    static const char *const dash[SVG_SERIES] = {"none", "7 3", "2 3", "9 3 2 3", "none", "5 5", "1 4", "12 4"};
    for (int s = 0; s < SVG_SERIES; s++) fprintf(to, ".s%d{stroke:var(--c%d);stroke-width:2;fill:none;stroke-dasharray:%s}.m%d{fill:var(--c%d)}\n", s, s, dash[s], s, s);
    fputs("@media print{nav,form{display:none}body{font-size:10pt;max-width:none}figure,tr{break-inside:avoid}:root{--ground:#fff;--ink:#000;--line:#bbb;--box:#f4f4f4}}\n", to);
}
static inline void page_style(const atlas *a)
{
    part_file page = page_file(a, "atlas", "css");
    style_words(page.to);
    page_done(&page);
}

static const char *const atlas_script =
    "<script>\n"
    "for (const table of document.querySelectorAll('table.sort')) {\n"
    "  const heads = [...table.tHead.rows[0].cells];\n"
    "  heads.forEach((head, column) => head.querySelector('button').addEventListener('click', () => {\n"
    "    const way = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;\n"
    "    for (const other of heads) other.setAttribute('aria-sort', 'none');\n"
    "    head.setAttribute('aria-sort', way > 0 ? 'ascending' : 'descending');\n"
    "    const value = row => { const c = row.cells[column]; return c.dataset.v === undefined ? c.textContent : Number(c.dataset.v); };\n"
    "    const rows = [...table.tBodies[0].rows].sort((a, b) => { const x = value(a), y = value(b); return way * (typeof x === 'number' ? x - y : x.localeCompare(y)); });\n"
    "    table.tBodies[0].append(...rows);\n"
    "  }));\n"
    "}\n"
    "const form = document.querySelector('form');\n"
    "function choose() {\n"
    "  const text = form.words ? form.words.value.toLowerCase() : '', family = form.family.value;\n"
    "  const asked = [...form.querySelectorAll('input[type=checkbox]')].filter(box => box.checked).map(box => box.name);\n"
    "  let shown = 0;\n"
    "  for (const row of document.querySelectorAll('table.sort tbody tr')) {\n"
    "    const good = row.textContent.toLowerCase().includes(text) && (!family || row.dataset.family === family) && asked.every(name => row.dataset.good.split(' ').includes(name));\n"
    "    row.hidden = !good;\n"
    "    shown += good;\n"
    "  }\n"
    "  document.querySelector('output').textContent = shown + ' operators';\n"
    "}\n"
    "if (form) { form.addEventListener('input', choose); form.addEventListener('submit', event => event.preventDefault()); choose(); }\n"
    "</script>\n";

static inline void family_select(FILE *to)
{
    fputs("<label>Family <select name=\"family\"><option value=\"\">all</option>", to);
    for (int f = 0; f < FAMILIES; f++) fprintf(to, "<option value=\"%d\">%s</option>", f, family(f).heading);
    fputs("</select></label>\n", to);
}

/* What is above the rows of the table, and the beginning of a row: no number is in it that was measured. */
static inline void index_words(FILE *to, const config *first)
{
    static const char *const column[] = {"operator", "exact for", "order inside lattices", "order in disorder", "order at boundaries", "error, lattice", "error, jittered", "error, random",
                                         "error, wall", "error, corner", "sum over all", "one sign", "cost 2D", "cost 3D"};
    fprintf(to, "<p>What each operator does to particles, measured by one program: on lattices, in disorder, at walls, free surfaces and corners. "
                "Errors are root mean squares, in units of the size of the answer, at 64 particles for a length of one (a wave of the field that is looked at is two and a half long); here in 2D with %s and h = %.1f dx (gravity: 3D). "
                "Orders are those against the spacing, for h / dx fixed: 0 means that more particles do not help. "
                "<a href=\"choose.html\">Which operator shall I take?</a></p>\n", sph_kernel_name(first->k), first->h_dx);
    fputs("<form><label>Words <input name=\"words\" type=\"search\"></label>\n", to);
    family_select(to);
    fputs("<output aria-live=\"polite\"></output></form>\n<div class=\"scroll\" role=\"region\" aria-label=\"all operators\" tabindex=\"0\"><table class=\"sort\">\n"
          "<caption>A heading sorts by its column. Cost: time for a particle, in units of sph_density_summation.</caption>\n<thead><tr>", to);
    for (size_t c = 0; c < sizeof column / sizeof column[0]; c++) fprintf(to, "<th scope=\"col\" aria-sort=\"none\"><button type=\"button\">%s</button></th>", column[c]);
    fputs("</tr></thead>\n<tbody>\n", to);
}
static inline void index_row(FILE *to, const op *o)
{
    fprintf(to, "<tr data-family=\"%d\" data-good=\"\"><th scope=\"row\"><a href=\"%s.html\">%s</a></th>", o->family, o->id, o->id);
}
static inline void page_index(const atlas *a)
{
    part_file page = page_open(a, "index", "Atlas of operators");
    FILE *const to = page.to;
    char text[32];
    index_words(to, &a->configs[0]);
    for (int q = 0; q < a->count; q++) {
        const op *const o = &a->operators[q];
        const result *const r = &a->results[q];
        const portrait *const seen = shown(o, r);
        const errors *const e = &r->at[0];
        double order[3];
        measured_orders(e, order);
        index_row(to, o);
        if (o->family < WITH_ERRORS) cell(to, seen->exact, degree_text(seen->exact));
        else cell(to, (double)NAN, "-");
        for (int c = 0; c < 3; c++) cell(to, order[c], order_text(text, order[c]));
        const double error[5] = {e->rms[SAMPLE_LATTICE][REGION_INSIDE][SHOWN], e->rms[SAMPLE_JITTER][REGION_INSIDE][SHOWN], e->rms[SAMPLE_RANDOM][REGION_INSIDE][SHOWN],
                                 worse(e->rms[SAMPLE_LATTICE][REGION_WALL][SHOWN], e->rms[SAMPLE_LATTICE][REGION_SURFACE][SHOWN]), e->rms[SAMPLE_LATTICE][REGION_CORNER][SHOWN]};
        for (int c = 0; c < 5; c++) cell(to, error[c], error_text(text, error[c]));
        if (has_sum(o)) cell(to, seen->momentum, seen->momentum < 1e-10 ? "kept" : "not kept");
        else cell(to, (double)NAN, "-");
        if (has_rows(o)) cell(to, 1.0 - r->of[0].monotone_all, (snprintf(text, sizeof text, "%.0f %%", 100.0 * r->of[0].monotone_all), text));
        else cell(to, (double)NAN, "-");
        for (int d = 0; d < 2; d++) cell(to, r->cost[d], isnan(r->cost[d]) ? "-" : (snprintf(text, sizeof text, "%.1f", r->cost[d]), text));
        fputs("</tr>\n", to);
    }
    fputs("</tbody></table></div>\n", to);
    fputs(atlas_script, to);
    page_close(a, &page);
}

/* ---- an operator's page ---- */

static inline void page_numbers(FILE *to, const errors *e, const config *c)
{
    char text[32];
    fprintf(to, "<div class=\"scroll\"><table><caption>%dD, %s, h = %.1f dx: error at dx = 1/64 (order)</caption><thead><tr><th scope=\"col\">cloud</th>", c->dim, sph_kernel_name(c->k), c->h_dx);
    for (int region = 0; region < REGIONS; region++) fprintf(to, "<th scope=\"col\">%s</th>", sample_region_name(region));
    fputs("<th scope=\"col\">worst particle</th><th scope=\"col\">its conditioning</th></tr></thead><tbody>\n", to);
    for (int kind = 0; kind < SAMPLE_KINDS; kind++) {
        fprintf(to, "<tr><th scope=\"row\">%s</th>", sample_kind_name(kind));
        for (int region = 0; region < REGIONS; region++) {
            fprintf(to, "<td>%s ", error_text(text, e->rms[kind][region][SHOWN]));
            fprintf(to, "(%s)</td>", order_text(text, order_of(e->rms[kind][region])));
        }
        fprintf(to, "<td>%s</td>", error_text(text, e->worst_error[kind]));
        if (e->worst_conditioning[kind] == 1.0) fputs("<td>not told</td></tr>\n", to);
        else fprintf(to, "<td>%.2g (lower: %.0f %%)</td></tr>\n", e->worst_conditioning[kind], 100.0 * e->worst_rank[kind]);
    }
    fputs("</tbody></table></div>\n", to);
}
static inline void page_status(FILE *to, const errors *e)
{
    static const char *const name[STATUSES] = {"ok", "too few", "singular", "ill-conditioned", "fell back", "not available", "not finite", "list too short"};
    int any = 0;
    for (int kind = 0; kind < SAMPLE_KINDS; kind++)
        for (int region = 0; region < REGIONS; region++)
            for (int s = 1; s < STATUSES; s++)
                if (e->status[kind][region][s] > 0.0) {
                    if (!any) fputs("<h2>Statuses</h2>\n<ul>\n", to);
                    any = 1;
                    fprintf(to, "<li>%s, %s: %.0f %% of the particles are %s</li>\n", sample_kind_name(kind), sample_region_name(region), 100.0 * e->status[kind][region][s], name[s]);
                }
    fputs(any ? "</ul>\n" : "<p>Every particle of every cloud is ok.</p>\n", to);
}

/* What is read from the table and from sph_ops.h. */
static inline void operator_words(FILE *to, const op *o, const header *says)
{
    passage comment, signature;
    fprintf(to, "<p>%s. <code>%s</code> of <code>sph_ops.h</code>.</p>\n<div class=\"equation\">", family(o->family).heading, o->function);
    mathml_write(to, o->formula);
    fputs("</div>\n<dl><dt>Source</dt><dd>", to);
    html_text(to, o->source, strlen(o->source));
    fputs("</dd><dt>To know</dt><dd>", to);
    html_text(to, o->note, strlen(o->note));
    fprintf(to, "</dd><dt>List</dt><dd>%s</dd></dl>\n", list_kind_text(o->list));
    if (header_function(says, o->function, &comment, &signature)) {
        fputs("<h2>Call</h2>\n<pre>", to);
        html_text(to, signature.from + strlen("SPH_FN "), (size_t)(signature.to - signature.from) - strlen("SPH_FN "));
        fputs("</pre>\n<h2>What the header says</h2>\n<pre>", to);
        html_text(to, comment.from, (size_t)(comment.to - comment.from));
        fputs("</pre>\n", to);
    }
}
static inline void claim_words(FILE *to, const claim *c)
{
    fprintf(to, "<tr><th scope=\"row\">sph_ops.h</th><td>%s</td><td>%s</td><td>%d</td><td>%d</td><td>%d</td></tr>\n", degree_text(c->exact), degree_text(c->exact_lattice), c->order[0], c->order[1], c->order[2]);
}
static inline void page_exactness(FILE *to, const result *r)
{
    char text[32];
    fputs("<h2>Exactness and order, said and measured</h2>\n<div class=\"scroll\"><table><thead><tr><th scope=\"col\"></th><th scope=\"col\">exact for</th><th scope=\"col\">inside lattices for</th><th scope=\"col\">order inside lattices</th><th scope=\"col\">in disorder</th><th scope=\"col\">at boundaries</th></tr></thead><tbody>\n", to);
    if (r->claim.given > 0) claim_words(to, &r->claim);
    for (int d = 0; d < 2; d++) {
        double order[3];
        measured_orders(&r->at[d], order);
        fprintf(to, "<tr><th scope=\"row\">measured in %dD</th><td>%s</td><td>%s</td>", d + 2, degree_text(r->of[d].exact), degree_text(r->of[d].exact_lattice));
        for (int c = 0; c < 3; c++) fprintf(to, "<td>%s</td>", order_text(text, order[c]));
        fputs("</tr>\n", to);
    }
    fputs("</tbody></table></div>\n", to);
}
static inline void page_errors(FILE *to, const atlas *a, const result *r)
{
    fputs("<h2>Errors</h2>\n", to);
    for (int c = 0; c < 2; c++) page_numbers(to, &r->at[c], &a->configs[c]);
    page_status(to, &r->at[0]);
    if (a->configurations > 2) fputs("<details><summary>Other kernels and lengths</summary>\n", to);
    for (int c = 2; c < a->configurations; c++) page_numbers(to, &r->at[c], &a->configs[c]);
    if (a->configurations > 2) fputs("</details>\n", to);
}
static inline void page_plots(FILE *to, const op *o, const result *r)
{
    const portrait *const p = &r->of[0];
    fputs("<h2>Plots</h2>\n<p>2D, the first of the tables above.</p>\n<div class=\"plots\">\n", to);
    double spacing[LEVELS], away[DISTANCES], waves[WAVES], part[4][WAVES];
    for (int level = 0; level < LEVELS; level++) spacing[level] = level_spacing(level);
    for (int d = 0; d < DISTANCES; d++) away[d] = 0.5 * d;
    {
        svg_plot plot = {"Error inside", "spacing dx", "error", 1, 1, 0, 0.0, 0.0, 0, {{0}}};
        for (int kind = 0; kind < SAMPLE_KINDS; kind++) svg_add(&plot, sample_kind_name(kind), spacing, r->at[0].rms[kind][REGION_INSIDE], LEVELS);
        svg_write(to, &plot);
    }
    {
        svg_plot plot = {"Error at boundaries", "spacing dx", "error", 1, 1, 0, 0.0, 0.0, 0, {{0}}};
        svg_add(&plot, "lattice, wall", spacing, r->at[0].rms[SAMPLE_LATTICE][REGION_WALL], LEVELS);
        svg_add(&plot, "lattice, free surface", spacing, r->at[0].rms[SAMPLE_LATTICE][REGION_SURFACE], LEVELS);
        svg_add(&plot, "lattice, corner", spacing, r->at[0].rms[SAMPLE_LATTICE][REGION_CORNER], LEVELS);
        svg_add(&plot, "random, wall", spacing, r->at[0].rms[SAMPLE_RANDOM][REGION_WALL], LEVELS);
        svg_add(&plot, "random, corner", spacing, r->at[0].rms[SAMPLE_RANDOM][REGION_CORNER], LEVELS);
        svg_write(to, &plot);
    }
    {
        svg_plot plot = {"Error against the distance from a boundary, lattice, dx = 1/32", "distance / dx", "error", 0, 1, 0, 0.0, 0.0, 0, {{0}}};
        svg_add(&plot, "wall", away, p->at_distance[0], DISTANCES);
        svg_add(&plot, "free surface", away, p->at_distance[1], DISTANCES);
        svg_write(to, &plot);
    }
    {
        svg_plot plot = {"Error against jitter, inside, dx = 1/32", "largest displacement / dx", "error", 0, 1, 0, 0.0, 0.0, 0, {{0}}};
        svg_add(&plot, "2D", atlas_jitter, p->at_jitter, JITTERS);
        svg_add(&plot, "3D", atlas_jitter, r->of[1].at_jitter, JITTERS);
        svg_write(to, &plot);
    }
    if (o->family < LINEAR) {
        svg_plot plot = {"Response to a wave, as a share of the true one", "k dx", "share", 0, 0, 0, -0.5, 1.6, 0, {{0}}};
        for (int w = 0; w < WAVES; w++) {
            waves[w] = acos(-1.0) * (w + 1) / WAVES;
            for (int d = 0; d < 2; d++) part[2 * d][w] = p->transfer[d][w].re, part[2 * d + 1][w] = p->transfer[d][w].im;
        }
        svg_add(&plot, "axis, real", waves, part[0], WAVES);
        svg_add(&plot, "axis, imaginary", waves, part[1], WAVES);
        svg_add(&plot, "diagonal, real", waves, part[2], WAVES);
        svg_add(&plot, "diagonal, imaginary", waves, part[3], WAVES);
        svg_write(to, &plot);
    }
    if (p->eigenvalues) {
        double *const re = numbers(p->eigenvalues), *const im = numbers(p->eigenvalues);
        for (int v = 0; v < p->eigenvalues; v++) re[v] = p->eigenvalue[v].re, im[v] = p->eigenvalue[v].im;
        svg_plot plot = {"Eigenvalues times dx&#178;, jittered, values given at the edge", "real part", "imaginary part", 0, 0, 1, 0.0, 0.0, 0, {{0}}};
        svg_add(&plot, "eigenvalue", re, im, p->eigenvalues);
        svg_write(to, &plot);
        free(re);
        free(im);
    }
    fputs("</div>\n", to);
}
/* The figures of operators that are not linear. */
static inline void page_figures(FILE *to, const result *r, const config *configs)
{
    char text[32];
    fputs("<h2>Figures</h2>\n<p>On small clouds with the spacing dx, without periodic boundaries.</p>\n", to);
    for (int d = 0; d < 2; d++) {
        if (!r->of[d].figure_count) continue;
        fprintf(to, "<div class=\"scroll\" role=\"region\" aria-label=\"figures in %dD\" tabindex=\"0\"><table><caption>%dD, %s, h = %.1f dx</caption><thead><tr><th scope=\"col\"></th>", configs[d].dim, configs[d].dim,
                sph_kernel_name(configs[d].k), configs[d].h_dx);
        for (int kind = 0; kind < SAMPLE_KINDS; kind++) fprintf(to, "<th scope=\"col\">%s</th>", sample_kind_name(kind));
        fputs("</tr></thead><tbody>\n", to);
        for (int f = 0; f < r->of[d].figure_count; f++) {
            fprintf(to, "<tr><th scope=\"row\" class=\"words\">%s</th>", r->of[d].figures[f].name);
            for (int kind = 0; kind < SAMPLE_KINDS; kind++) {
                const double value = r->of[d].figures[f].value[kind];
                fprintf(to, "<td>%s%s</td>", value < 0.0 && value < -1e-11 ? "&#8722;" : "", error_text(text, fabs(value)));
            }
            fputs("</tr>\n", to);
        }
        fputs("</tbody></table></div>\n", to);
    }
}
static inline void page_properties(FILE *to, const atlas *a, const op *o, const result *r)
{
    const portrait *const p = shown(o, r);
    char text[32];
    fprintf(to, "<h2>Properties</h2>\n<p>On %s, without periodic boundaries.</p>\n<dl>\n", o->family < LINEAR ? "a small jittered cloud in 2D" : o->family == GRAVITY ? "the clouds of the figures, the worst of all" : "the clouds of the figures in 2D, the worst of all");
    if (has_rows(o)) {
        fprintf(to, "<dt>Signs of the weights</dt><dd>%.0f %% of the rows have neighbours of one sign (inside: %.0f %%)</dd>\n", 100.0 * p->monotone_all, 100.0 * p->monotone_inside);
        fprintf(to, "<dt>Symmetry</dt><dd>V<sub>i</sub> L<sub>ij</sub> differs from V<sub>j</sub> L<sub>ji</sub> by %s of its size</dd>\n", error_text(text, p->symmetry));
    }
    if (p->eigenvalues)
        fprintf(to, "<dt>Spectrum</dt><dd>real parts from %.3g to %.3g, imaginary parts up to %.2g; condition %.3g</dd>\n", p->re_least, p->re_most, p->im_most, p->condition);
    if (has_sum(o)) {
        fprintf(to, "<dt>%s</dt><dd>%s of the sum of sizes: it is %s</dd>\n", o->family < LINEAR ? "Sum over all particles" : o->family == SHIFTING ? "Centre of volume" : "Momentum", error_text(text, p->momentum < 1e-11 ? 0.0 : p->momentum), p->momentum < 1e-10 ? "kept" : "not kept");
        if (family(o->family).out == 1 && o->family != SHIFTING)
            fprintf(to, "<dt>Angular momentum</dt><dd>%s: it is %s</dd>\n", error_text(text, p->angular < 1e-11 ? 0.0 : p->angular), p->angular < 1e-10 ? "kept" : "not kept");
        if (o->family == RATES || o->family == COLLISIONS) fprintf(to, "<dt>Energy</dt><dd>%s for random velocities</dd>\n", p->energy < 1e-10 ? "never grew" : "grew");
        if (o->family == GRAVITY) fprintf(to, "<dt>Energy</dt><dd>the work of the forces is that of the potential, but for %s of it</dd>\n", error_text(text, p->energy));
        if (is_laplacian(o) || o->family == VISCOSITY) fprintf(to, "<dt>Energy</dt><dd>the sum of V f L f was %s for random fields</dd>\n", p->energy < 0.0 ? "always negative: it damps" : "not always negative");
    }
    if (p->conjugates) {
        fputs("<dt>Conjugate to</dt><dd>", to);
        for (int c = 0; c < p->conjugates; c++) fprintf(to, "%s<a href=\"%s.html\">%s</a>", c ? ", " : "", a->operators[p->conjugate[c]].id, a->operators[p->conjugate[c]].id);
        fputs(": the sum of V f div A is minus the sum of V A &#8901; grad f, to rounding</dd>\n", to);
    }
    fprintf(to, "<dt>Rotation</dt><dd>turning everything changes the result by %s of its size</dd>\n", error_text(text, p->rotation));
    if (!isnan(r->cost[0]) && o->family != GRAVITY) fprintf(to, "<dt>Cost</dt><dd>%.1f times that of a density in 2D, %.1f times in 3D (%.0f and %.0f ns for a particle)</dd>\n", r->cost[0], r->cost[1], r->cost_ns[0], r->cost_ns[1]);
    if (!isnan(r->cost[1]) && o->family == GRAVITY) fprintf(to, "<dt>Cost</dt><dd>%.0f times that of a density (%.0f ns for a particle)</dd>\n", r->cost[1], r->cost_ns[1]);
    fputs("</dl>\n", to);
}
static inline void page_operator(const atlas *a, int q)
{
    const op *const o = &a->operators[q];
    const result *const r = &a->results[q];
    part_file page = page_open(a, o->id, o->id);
    operator_words(page.to, o, a->says);
    if (o->family < WITH_ERRORS) {
        page_exactness(page.to, r);
        page_errors(page.to, a, r);
        page_plots(page.to, o, r);
    }
    if (o->family >= LINEAR) page_figures(page.to, r, a->configs);
    page_properties(page.to, a, o, r);
    page_close(a, &page);
}

/* ---- kernels.html ---- */

/* W, -F = -(1/r) dW/dr, and the Fourier transform of W in 3D: 4 pi / k integral of W sin(k r) r dr, by Simpson's rule. */
enum { KERNEL_POINTS = 61, KERNEL_STEPS = 400, KERNEL_GROUP = 6, KERNEL_GROUPS = (SPH_KERNEL_COUNT + KERNEL_GROUP - 1) / KERNEL_GROUP };
static inline double kernel_transform(sph_kernel kernel, double k)
{
    const double end = (double)sph_kernel_support_ratio(kernel), step = end / KERNEL_STEPS;
    double sum = 0.0;
    for (int q = 1; q <= KERNEL_STEPS; q++) {
        const double r = q * step;
        sum += (q == KERNEL_STEPS ? 1.0 : q % 2 ? 4.0 : 2.0) * (double)sph_kernel_w(kernel, 3, SPH_R(r), SPH_R(1)) * (k > 0.0 ? sin(k * r) / k : r) * r;
    }
    return 4.0 * acos(-1.0) * sum * step / 3.0;
}
/* The density that is summed up on a lattice, where 1 is right. */
static inline double kernel_density(sph_kernel kernel, int dim, double h_dx)
{
    const int reach = (int)ceil((double)sph_kernel_support_ratio(kernel) * h_dx);
    double sum = 0.0;
    for (int z = dim > 2 ? -reach : 0; z <= (dim > 2 ? reach : 0); z++)
        for (int y = -reach; y <= reach; y++)
            for (int x = -reach; x <= reach; x++) sum += (double)sph_kernel_w(kernel, dim, SPH_R(sqrt(x * x + y * y + z * z)), SPH_R(h_dx));
    return sum;
}
static inline void kernels_words(FILE *to)
{
    fputs("<p>All lengths are in units of the support, so that kernels can be compared at an equal number of neighbours. Where the Fourier transform is negative, particles may pair: "
          "a wave of that length gains energy (Dehnen &amp; Aly 2012); here it counts from &#8722;1e-5 on. The density is what a perfect lattice of the density 1 sums up.</p>\n<div class=\"scroll\" role=\"region\" aria-label=\"kernels\" tabindex=\"0\"><table class=\"sort\"><thead><tr>", to);
    static const char *const column[] = {"kernel", "support / h", "usual h / dx", "density, 2D", "density, 3D", "h = 2 dx, 2D", "h = 2 dx, 3D", "least of the transform", "can pair"};
    for (size_t c = 0; c < sizeof column / sizeof column[0]; c++) fprintf(to, "<th scope=\"col\" aria-sort=\"none\"><button type=\"button\">%s</button></th>", column[c]);
}
static inline void kernels_row(FILE *to, sph_kernel kernel) { fprintf(to, "<tr><th scope=\"row\">%s</th>", sph_kernel_name(kernel)); }
static inline void page_kernels(const atlas *a)
{
    static double x[KERNEL_POINTS], k[KERNEL_POINTS], length[KERNEL_POINTS], w[SPH_KERNEL_COUNT][KERNEL_POINTS], f[SPH_KERNEL_COUNT][KERNEL_POINTS], transform[SPH_KERNEL_COUNT][KERNEL_POINTS],
        density[SPH_KERNEL_COUNT][KERNEL_POINTS];
    part_file page = page_open(a, "kernels", "Kernels");
    FILE *const to = page.to;
    for (int q = 0; q < KERNEL_POINTS; q++) {
        x[q] = (double)q / (KERNEL_POINTS - 1);
        k[q] = 24.0 * q / (KERNEL_POINTS - 1);
        length[q] = 1.5 + 3.0 * q / (KERNEL_POINTS - 1);
        for (int n = 0; n < (int)SPH_KERNEL_COUNT; n++) {
            const sph_kernel kernel = (sph_kernel)n;
            const double ratio = (double)sph_kernel_support_ratio(kernel), r = ratio * x[q];
            w[n][q] = (double)sph_kernel_w(kernel, 3, SPH_R(r), SPH_R(1)) * pow(ratio, 3.0);
            f[n][q] = q ? -(double)sph_kernel_f(kernel, 3, SPH_R(r), SPH_R(1)) * pow(ratio, 5.0) : (double)NAN;
            transform[n][q] = kernel_transform(kernel, k[q] / ratio);
            density[n][q] = kernel_density(kernel, 2, length[q] / ratio) - 1.0;
        }
    }
    kernels_words(to);
    fputs("</tr></thead>\n<tbody>\n", to);
    for (int n = 0; n < (int)SPH_KERNEL_COUNT; n++) {
        const sph_kernel kernel = (sph_kernel)n;
        const double usual = (double)sph_kernel_h_over_dx(kernel);
        double least = 1.0;
        for (int q = 0; q < 4 * KERNEL_POINTS; q++) least = fmin(least, kernel_transform(kernel, 40.0 * q / (4 * KERNEL_POINTS) / (double)sph_kernel_support_ratio(kernel)));
        const double value[7] = {(double)sph_kernel_support_ratio(kernel), usual, kernel_density(kernel, 2, usual), kernel_density(kernel, 3, usual), kernel_density(kernel, 2, 2.0), kernel_density(kernel, 3, 2.0), least};
        kernels_row(to, kernel);
        for (int c = 0; c < 7; c++) fprintf(to, c < 2 ? "<td data-v=\"%.6g\">%.2g</td>" : c < 6 ? "<td data-v=\"%.6g\">%.4f</td>" : "<td data-v=\"%.6g\">%.1e</td>", value[c], fabs(value[c]) < 1e-7 ? 0.0 : value[c]);
        fprintf(to, "<td>%s</td></tr>\n", yes_no(least < -1e-5));
    }
    fputs("</tbody></table></div>\n<h2>Plots</h2>\n<div class=\"plots\">\n", to);
    for (int group = 0; group < (int)KERNEL_GROUPS; group++) {
        svg_plot plots[4] = {{"W in 3D", "r / support", "W support&#179;", 0, 0, 0, 0.0, 20.0, 0, {{0}}},
                             {"&#8722;F = &#8722;(1/r) dW/dr in 3D", "r / support", "&#8722;F support&#8309;", 0, 0, 0, 0.0, 120.0, 0, {{0}}},
                             {"Fourier transform in 3D", "k support", "transform", 0, 0, 0, 0.0, 0.0, 0, {{0}}},
                             {"Error of the density on a lattice in 2D", "support / dx", "error", 0, 0, 0, -0.1, 0.2, 0, {{0}}}};
        for (int n = group * KERNEL_GROUP; n < (group + 1) * KERNEL_GROUP && n < (int)SPH_KERNEL_COUNT; n++) {
            const char *const name = sph_kernel_name((sph_kernel)n);
            svg_add(&plots[0], name, x, w[n], KERNEL_POINTS);
            svg_add(&plots[1], name, x, f[n], KERNEL_POINTS);
            svg_add(&plots[2], name, k, transform[n], KERNEL_POINTS);
            svg_add(&plots[3], name, length, density[n], KERNEL_POINTS);
        }
        for (int c = 0; c < 4; c++) svg_write(to, &plots[c]);
    }
    fputs("</div>\n", to);
    fputs(atlas_script, to);
    page_close(a, &page);
}

/* ---- choose.html ---- */

/* The five questions: what an operator must have measured. */
enum { QUESTIONS = 5 };
static inline int answers_well(const atlas *a, int q, int question)
{
    const op *const o = &a->operators[q];
    const result *const r = &a->results[q];
    double order[3], usual[64];
    int count = 0;
    measured_orders(&r->at[0], order);
    switch (question) {
    case 0: return order[2] > 0.6;
    case 1: return order[1] > 0.6;
    case 2: return has_sum(o) && shown(o, r)->momentum < 1e-10;
    case 3: return has_rows(o) && r->of[0].monotone_all > 0.999;
    default: /* not dearer than the middle one of its family */
        if (isnan(r->cost[0])) return 0;
        for (int b = 0; b < a->count && count < 64; b++)
            if (a->operators[b].family == o->family && !isnan(a->results[b].cost[0])) usual[count++] = a->results[b].cost[0];
        statistics_sort(usual, count);
        return r->cost[0] <= statistics_quantile(usual, count, 0.5);
    }
}
/* The figure that answers a question: the smaller the better; and in words. */
static inline double answer_figure(const atlas *a, int q, int question, char text[96])
{
    const result *const r = &a->results[q];
    const errors *const e = &r->at[0];
    char one[32], two[32];
    double order[3];
    measured_orders(e, order);
    switch (question) {
    case 0: {
        const double error = worse(e->rms[SAMPLE_LATTICE][REGION_WALL][SHOWN], e->rms[SAMPLE_LATTICE][REGION_SURFACE][SHOWN]);
        snprintf(text, 96, "%s, order %s", error_text(one, error), order_text(two, order[2]));
        return error;
    }
    case 1: {
        const double error = e->rms[SAMPLE_RANDOM][REGION_INSIDE][SHOWN];
        snprintf(text, 96, "%s, order %s", error_text(one, error), order_text(two, order[1]));
        return error;
    }
    case 2: {
        const double momentum = shown(&a->operators[q], r)->momentum;
        snprintf(text, 96, "%s", error_text(one, momentum < 1e-10 ? 0.0 : momentum));
        return momentum;
    }
    case 3: snprintf(text, 96, "%.0f %%", 100.0 * r->of[0].monotone_all); return 1.0 - r->of[0].monotone_all;
    default: snprintf(text, 96, "%.1f", r->cost[0]); return r->cost[0];
    }
}
/* What follows from a question: of each family the operators that have it, the best first, and those that have not. */
static inline void answer_words(FILE *to, int question)
{
    static const char *const says[QUESTIONS][3] = {
        {"Boundaries?", "If supports are cut off, take what is renormalised: its error falls there with the spacing. A quadratic fit gains another order for gradients, and is what second derivatives need. "
         "Without it, keep the uncorrected form and give it particles or integrals behind the boundary.", "error next to a wall or free surface of a lattice at dx = 1/64, and its order"},
        {"Disorder?", "On a lattice nearly all are of second order, down to what h / dx leaves. On particles that move, only what is exact for linear fields (gradients) or quadratic ones (second derivatives) gets better with more of them.",
         "error on random particles, inside, at dx = 1/64, and its order"},
        {"Conservation?", "Forces and fluxes that must not create momentum or heat are sums over pairs with the same weight from both sides. They are inconsistent pointwise, and their particles order themselves instead.",
         "what is left of the sum over all particles, relative"},
        {"Signs of the matrix?", "With weights of one sign a maximum does not grow, explicit steps are stable up to a known limit, and simple solvers converge.", "rows with one sign, on a jittered cloud with its edges"},
        {"Cost?", "If all else is equal. Corrections that are computed once and used often (sph_rk_correction, sph_gradient_correction_iad) are not counted, rows that are computed once and applied often are cheaper than the sweep.",
         "time as a multiple of a density's, in 2D"}};
    fprintf(to, "<h2>%s</h2>\n<p>%s In brackets: %s.</p>\n<ul>\n", says[question][0], says[question][1], says[question][2]);
}
static inline void answer_section(FILE *to, const atlas *a, int question)
{
    answer_words(to, question);
    for (int f = 0; f < FAMILIES; f++) {
        int rank[64], count = 0, good_ones = 0;
        double value[64];
        char text[96];
        for (int q = 0; q < a->count && count < 64; q++) {
            if (a->operators[q].family != f || (question == 3 && !has_rows(&a->operators[q])) || (question == 2 && !has_sum(&a->operators[q]))) continue;
            const int good = answers_well(a, q, question);
            const double figure_of = answer_figure(a, q, question, text) + (good ? 0.0 : 1e100);
            int place = count++;
            if (isnan(figure_of)) {
                count--;
                continue;
            }
            for (; place > 0 && value[place - 1] > figure_of; place--) value[place] = value[place - 1], rank[place] = rank[place - 1];
            value[place] = figure_of;
            rank[place] = q;
            good_ones += good;
        }
        if (!count) continue;
        fprintf(to, "<li>%s: %s", family(f).heading, good_ones ? "" : "none");
        for (int place = 0; place < count; place++) {
            answer_figure(a, rank[place], question, text);
            fprintf(to, "%s<a href=\"%s.html\">%s</a> (%s)", place == good_ones ? (place ? "; but not " : "; not ") : place ? ", " : "", a->operators[rank[place]].id, a->operators[rank[place]].id, text);
        }
        fputs("</li>\n", to);
    }
    fputs("</ul>\n", to);
}
static const char *const question_name[QUESTIONS] = {"boundary", "disorder", "conservation", "signs", "cost"};
static inline void choose_words(FILE *to)
{
    static const char *const text[QUESTIONS] = {"There are boundaries, and errors must fall there with the spacing", "Particles are in disorder, and errors must fall with the spacing",
                                                "The sum over all particles (momentum, heat) must be kept to rounding", "The matrix must have weights of one sign (maxima do not grow, solvers converge)",
                                                "It must be cheap: not above the middle of its family"};
    static const char *const what[QUESTIONS] = {"at boundaries", "in disorder", "keeps the sum", "one sign", "cost"};
    fputs("<p>Five questions. Mark what you need; what is left has it, by what was measured (2D). No operator has all: what conserves is inconsistent in disorder, and what is exact there does not conserve. "
          "Where nothing is left, give up the need that costs you least.</p>\n<form>\n", to);
    family_select(to);
    for (int k = 0; k < QUESTIONS; k++) fprintf(to, "<label><input type=\"checkbox\" name=\"%s\"> %s</label>\n", question_name[k], text[k]);
    fputs("<output aria-live=\"polite\"></output></form>\n<div class=\"scroll\" role=\"region\" aria-label=\"operators by need\" tabindex=\"0\"><table class=\"sort\"><caption>Orders of the error at boundaries and in disorder; the share of rows with one sign; cost in units of a density</caption>\n<thead><tr><th scope=\"col\" aria-sort=\"none\"><button type=\"button\">operator</button></th>", to);
    for (int k = 0; k < QUESTIONS; k++) fprintf(to, "<th scope=\"col\" aria-sort=\"none\"><button type=\"button\">%s</button></th>", what[k]);
    fputs("<th scope=\"col\" aria-sort=\"none\"><button type=\"button\">to know</button></th></tr></thead>\n<tbody>\n", to);
}
static inline void choose_row(FILE *to, const op *o) { fprintf(to, "<th scope=\"row\"><a href=\"%s.html\">%s</a></th>", o->id, o->id); }
static inline void note_words(FILE *to, const op *o)
{
    fputs("<td class=\"note\">", to);
    html_text(to, o->note, strlen(o->note));
    fputs("</td></tr>\n", to);
}
static inline void page_choose(const atlas *a)
{
    part_file page = page_open(a, "choose", "Which operator shall I take?");
    FILE *const to = page.to;
    char word[32];
    choose_words(to);
    for (int q = 0; q < a->count; q++) {
        const op *const o = &a->operators[q];
        const result *const r = &a->results[q];
        double order[3];
        measured_orders(&r->at[0], order);
        fprintf(to, "<tr data-family=\"%d\" data-good=\"", o->family);
        for (int k = 0; k < QUESTIONS; k++)
            if (answers_well(a, q, k)) fprintf(to, "%s ", question_name[k]);
        fputs("\">", to);
        choose_row(to, o);
        cell(to, -order[2], order_text(word, order[2]));
        cell(to, -order[1], order_text(word, order[1]));
        if (has_sum(o)) cell(to, shown(o, r)->momentum, yes_no(shown(o, r)->momentum < 1e-10));
        else cell(to, (double)NAN, "-");
        if (has_rows(o)) cell(to, 1.0 - r->of[0].monotone_all, (snprintf(word, sizeof word, "%.0f %%", 100.0 * r->of[0].monotone_all), word));
        else cell(to, (double)NAN, "-");
        cell(to, r->cost[0], isnan(r->cost[0]) ? "-" : (snprintf(word, sizeof word, "%.1f", r->cost[0]), word));
        note_words(to, o);
    }
    fputs("</tbody></table></div>\n", to);
    for (int k = 0; k < QUESTIONS; k++) answer_section(to, a, k);
    fputs(atlas_script, to);
    page_close(a, &page);
}

static inline void pages_write(const atlas *a)
{
    page_kernels(a);
    page_style(a);
    page_index(a);
    page_choose(a);
    for (int q = 0; q < a->count; q++) page_operator(a, q);
}

/* ---- pages that are kept: do they say what the table and the comments say now? ---- */

typedef struct kept_page {
    char path[1024], *text;
    const char *at; /* what comes next is looked for from here */
    int stale;
} kept_page;
static inline kept_page kept_open(const char *folder, const char *name)
{
    kept_page k;
    snprintf(k.path, sizeof k.path, "%s/%s", folder, name);
    k.at = k.text = file_text(k.path);
    k.stale = !k.text;
    if (k.stale) fprintf(stderr, "atlas: no file %s\n", k.path);
    return k;
}
static inline FILE *words_open(void)
{
    FILE *const words = tmpfile();
    if (words) return words;
    fprintf(stderr, "atlas: no temporary file can be made\n");
    exit(2);
}
/* Looks for these words, and closes them. */
static inline void kept_has(kept_page *k, FILE *words)
{
    const long length = ftell(words);
    char *const want = (char *)need(NULL, (size_t)length + 1, 1);
    rewind(words);
    want[fread(want, 1, (size_t)length, words)] = '\0';
    fclose(words);
    const char *const found = k->text ? strstr(k->at, want) : NULL;
    if (found) k->at = found + length;
    else if (k->text && !k->stale) {
        long same = 0; /* how much of it is there */
        for (int there = 1; there && same < length; same += there) {
            const char next = want[same + 1];
            want[same + 1] = '\0';
            there = strstr(k->at, want) != NULL;
            want[same + 1] = next;
        }
        k->stale = 1;
        for (char *line = want; (line = strchr(line, '\n')) != NULL;) *line = ' ';
        fprintf(stderr, "atlas: %s does not say: ...%.70s\n", k->path, want + (same > 20 ? same - 20 : 0));
    }
    free(want);
}
static inline int kept_close(kept_page *k)
{
    free(k->text);
    return k->stale;
}
#define KEPT(page, ...) \
    do { \
        FILE *const to = words_open(); \
        __VA_ARGS__; \
        kept_has(&(page), to); \
    } while (0)

/* Writes anew what an operator's page reads from the table and from sph_ops.h, and leaves what was measured. */
static inline void kept_mend(const kept_page *k, const op *o, const header *says, const char *folder)
{
    const atlas a = {NULL, NULL, NULL, 0, 0, 0, NULL, folder};
    const char *const measured = k->text ? strstr(k->text, o->family < WITH_ERRORS ? "<h2>Exactness and order" : "<h2>Figures") : NULL;
    if (!measured) return;
    part_file page = page_file(&a, o->id, "html");
    head_words(page.to, o->id);
    operator_words(page.to, o, says);
    fputs(measured, page.to);
    page_done(&page);
}

/* The number of files in the folder that say something else. mend: operators' pages are written anew as far as can be. */
static inline int pages_stale(const op *o, int count, const config *first, const header *says, const char *folder, int mend)
{
    int stale = 0;
    kept_page page = kept_open(folder, "atlas.css");
    KEPT(page, style_words(to));
    stale += kept_close(&page);
    page = kept_open(folder, "kernels.html");
    KEPT(page, head_words(to, "Kernels"));
    KEPT(page, kernels_words(to));
    for (int n = 0; n < (int)SPH_KERNEL_COUNT; n++) KEPT(page, kernels_row(to, (sph_kernel)n));
    stale += kept_close(&page);
    page = kept_open(folder, "index.html");
    KEPT(page, head_words(to, "Atlas of operators"));
    KEPT(page, index_words(to, first));
    for (int q = 0; q < count; q++) KEPT(page, index_row(to, &o[q]));
    stale += kept_close(&page);
    page = kept_open(folder, "choose.html");
    KEPT(page, head_words(to, "Which operator shall I take?"));
    KEPT(page, choose_words(to));
    for (int q = 0; q < count; q++) {
        KEPT(page, choose_row(to, &o[q]));
        KEPT(page, note_words(to, &o[q]));
    }
    for (int k = 0; k < QUESTIONS; k++) KEPT(page, answer_words(to, k));
    stale += kept_close(&page);
    for (int q = 0; q < count; q++) {
        const claim c = header_claim(says, o[q].function, family(o[q].family).word);
        char name[128];
        snprintf(name, sizeof name, "%s.html", o[q].id);
        page = kept_open(folder, name);
        KEPT(page, head_words(to, o[q].id));
        KEPT(page, operator_words(to, &o[q], says));
        if (o[q].family < WITH_ERRORS && c.given > 0) KEPT(page, claim_words(to, &c));
        if (mend && page.stale) kept_mend(&page, &o[q], says, folder);
        stale += kept_close(&page);
    }
    return stale;
}

#endif
