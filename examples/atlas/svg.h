/* SPDX-License-Identifier: MIT
 *
 * svg.h - plots as SVG inside of a page. Colours are those of the page's style, light and dark; series differ by
 * their dashes and marks as well.
 */
#ifndef ATLAS_SVG_H
#define ATLAS_SVG_H

#include <math.h>
#include <stdio.h>

enum { SVG_SERIES = 8, SVG_MARKED = 12 }; /* longer series are lines without marks */
typedef struct svg_series {
    const char *name;
    const double *x, *y;
    int n;
} svg_series;
typedef struct svg_plot {
    const char *title, *x, *y;
    int log_x, log_y, points; /* points: marks without lines */
    double lowest, highest;   /* of y, if they differ */
    int count;
    svg_series series[SVG_SERIES];
} svg_plot;

static inline void svg_add(svg_plot *p, const char *name, const double *x, const double *y, int n)
{
    if (p->count == SVG_SERIES) return;
    p->series[p->count].name = name;
    p->series[p->count].x = x;
    p->series[p->count].y = y;
    p->series[p->count++].n = n;
}
static inline int svg_shown(const svg_plot *p, double x, double y)
{
    return isfinite(x) && isfinite(y) && (!p->log_x || x > 0.0) && (!p->log_y || y > 1e-14);
}
static inline double svg_scaled(int logarithm, double v) { return logarithm ? log10(v) : v; }

/* A round step that divides a length into some four parts. */
static inline double svg_step(double length)
{
    const double raw = length / 4.0, power = pow(10.0, floor(log10(raw))), part = raw / power;
    return power * (part < 1.5 ? 1.0 : part < 3.5 ? 2.0 : part < 7.5 ? 5.0 : 10.0);
}

static inline void svg_write(FILE *to, const svg_plot *p)
{
    const double left = 80.0, right = 490.0, top = 14.0, bottom = 262.0;
    double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
    for (int s = 0; s < p->count; s++)
        for (int q = 0; q < p->series[s].n; q++) {
            const double x = p->series[s].x[q], y = p->series[s].y[q];
            if (!svg_shown(p, x, y)) continue;
            x0 = fmin(x0, svg_scaled(p->log_x, x));
            x1 = fmax(x1, svg_scaled(p->log_x, x));
            y0 = fmin(y0, svg_scaled(p->log_y, y));
            y1 = fmax(y1, svg_scaled(p->log_y, y));
        }
    if (x0 > x1) {
        fprintf(to, "<p>%s: nothing to show, because all errors are rounding.</p>\n", p->title);
        return;
    }
    if (p->highest > p->lowest) y0 = fmax(y0, p->lowest), y1 = fmin(y1, p->highest);
    if (p->log_y) y0 = floor(y0 + 1e-9), y1 = ceil(y1 - 1e-9);
    if (y1 - y0 < 1e-9) y0 -= 0.5, y1 += 0.5;
    if (x1 - x0 < 1e-9) x0 -= 0.5, x1 += 0.5;
    if (!p->log_y) {
        const double room = 0.04 * (y1 - y0);
        y0 -= room;
        y1 += room;
    }
    const double sx = (right - left) / (x1 - x0), sy = (bottom - top) / (y1 - y0);
    fprintf(to, "<figure><figcaption>%s</figcaption>\n<svg viewBox=\"0 0 515 310\" role=\"img\" aria-label=\"%s: %s against %s\">\n", p->title, p->title, p->y, p->x);
    const double step_y = p->log_y ? fmax(1.0, ceil((y1 - y0) / 6.0)) : svg_step(y1 - y0), step_x = p->log_x ? log10(2.0) : svg_step(x1 - x0);
    for (double v = ceil(y0 / step_y - 1e-6) * step_y; v <= y1 + 1e-9; v += step_y) {
        const double y = bottom - (v - y0) * sy;
        fprintf(to, "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/><text class=\"t\" text-anchor=\"end\" x=\"%.1f\" y=\"%.1f\">", left, y, right, left - 6.0, y + 4.0);
        if (p->log_y) fprintf(to, "10<tspan dy=\"-5\" font-size=\"10\">%.0f</tspan></text>\n", v);
        else fprintf(to, "%.6g</text>\n", fabs(v) < 1e-9 ? 0.0 : v);
    }
    for (double v = p->log_x ? x0 : ceil(x0 / step_x - 1e-6) * step_x; v <= x1 + 1e-9; v += step_x) {
        const double x = left + (v - x0) * sx;
        fprintf(to, "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/><text class=\"t\" text-anchor=\"middle\" x=\"%.1f\" y=\"%.1f\">", x, top, bottom, x, bottom + 17.0);
        if (p->log_x) fprintf(to, "1/%.0f</text>\n", pow(10.0, -v));
        else fprintf(to, "%.6g</text>\n", fabs(v) < 1e-9 ? 0.0 : v);
    }
    fprintf(to, "<text class=\"t\" text-anchor=\"middle\" x=\"%.0f\" y=\"%.0f\">%s</text>", 0.5 * (left + right), bottom + 38.0, p->x);
    fprintf(to, "<text class=\"t\" text-anchor=\"middle\" transform=\"translate(14 %.0f) rotate(-90)\">%s</text>\n", 0.5 * (top + bottom), p->y);
    for (int s = 0; s < p->count; s++) {
        const svg_series *const c = &p->series[s];
        int open = 0;
        if (!p->points) {
            fprintf(to, "<path class=\"s%d\" d=\"", s);
            for (int q = 0; q < c->n; q++) {
                if (!svg_shown(p, c->x[q], c->y[q])) continue;
                const double y = svg_scaled(p->log_y, c->y[q]);
                if (y < y0 || y > y1) { /* beyond what is wanted */
                    open = 0;
                    continue;
                }
                fprintf(to, "%c%.1f %.1f", open ? 'L' : 'M', left + (svg_scaled(p->log_x, c->x[q]) - x0) * sx, bottom - (y - y0) * sy);
                open = 1;
            }
            fputs("\"/>\n", to);
        }
        if (p->points) { /* all as one path, of lines without length that have round ends */
            fprintf(to, "<path class=\"p\" d=\"");
            for (int q = 0; q < c->n; q++)
                if (svg_shown(p, c->x[q], c->y[q])) fprintf(to, "M%.1f %.1fh0", left + (svg_scaled(p->log_x, c->x[q]) - x0) * sx, bottom - (svg_scaled(p->log_y, c->y[q]) - y0) * sy);
            fputs("\"/>\n", to);
            continue;
        }
        if (c->n > SVG_MARKED) continue;
        fprintf(to, "<g class=\"m%d\">", s);
        for (int q = 0; q < c->n; q++) {
            if (!svg_shown(p, c->x[q], c->y[q]) || svg_scaled(p->log_y, c->y[q]) < y0 || svg_scaled(p->log_y, c->y[q]) > y1) continue;
            const double x = left + (svg_scaled(p->log_x, c->x[q]) - x0) * sx, y = bottom - (svg_scaled(p->log_y, c->y[q]) - y0) * sy;
            if (s % 4 == 0) fprintf(to, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>", x, y);
            else if (s % 4 == 1) fprintf(to, "<path d=\"M%.1f %.1fh6v6h-6z\"/>", x - 3.0, y - 3.0);
            else if (s % 4 == 2) fprintf(to, "<path d=\"M%.1f %.1fl4 7h-8z\"/>", x, y - 4.0);
            else fprintf(to, "<path d=\"M%.1f %.1fl4 4l-4 4l-4-4z\"/>", x, y - 4.0);
        }
        fputs("</g>\n", to);
    }
    fputs("</svg>\n<ul class=\"legend\">", to);
    for (int s = 0; s < p->count; s++) {
        static const char *const mark[4] = {"<circle cx=\"15\" cy=\"6\" r=\"3\"/>", "<path d=\"M12 3h6v6h-6z\"/>", "<path d=\"M15 2l4 7h-8z\"/>", "<path d=\"M15 2l4 4l-4 4l-4-4z\"/>"};
        fprintf(to, "<li><svg width=\"30\" height=\"12\" aria-hidden=\"true\">");
        if (!p->points) fprintf(to, "<path class=\"s%d\" d=\"M0 6H30\"/>", s);
        fprintf(to, "<g class=\"m%d\">%s</g></svg> %s</li>", s, p->points ? mark[0] : p->series[s].n > SVG_MARKED ? "" : mark[s % 4], p->series[s].name);
    }
    fputs("</ul></figure>\n", to);
}

#endif
