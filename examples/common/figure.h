/* SPDX-License-Identifier: MIT */
/* figure.h - the data files of figures, and the constant that everybody needs. A file that cannot be written ends the program with status 2. */
#ifndef FIGURE_H
#define FIGURE_H

#include <stdio.h>
#include <stdlib.h>

#define MATH_PI 3.14159265358979323846

/* DIR/NAME.csv; the caller writes the header line first. */
static inline FILE *figure_open(const char *dir, const char *name)
{
    char path[4096];
    FILE *out;
    if (snprintf(path, sizeof path, "%s/%s.csv", dir, name) >= (int)sizeof path || !(out = fopen(path, "w"))) {
        fprintf(stderr, "cannot write %s/%s.csv; does the folder exist and may you write there? (-figures names it)\n", dir, name);
        exit(2);
    }
    return out;
}
/* Call it first: a folder that is missing or full is better known before the run than after it. */
static inline void figure_folder(const char *dir)
{
    char path[4096];
    fclose(figure_open(dir, "figure_folder"));
    snprintf(path, sizeof path, "%s/figure_folder.csv", dir);
    remove(path);
}
static inline void figure_close(FILE *out)
{
    const int broken = ferror(out);
    if (fclose(out) != 0 || broken) {
        fprintf(stderr, "writing a figure's data failed; is the disk full?\n");
        exit(2);
    }
}

#endif
