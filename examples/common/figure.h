/* SPDX-License-Identifier: MIT */
/* figure.h - the data files of figures, and the constant that everybody needs. A file has its name once it is closed (part_file.h); one that cannot be written ends the program with status 2. */
#ifndef FIGURE_H
#define FIGURE_H

#include "part_file.h"

#include <stdlib.h>

#define MATH_PI 3.14159265358979323846

enum { FIGURES_OPEN = 16 };                 /* at a time */
static part_file figure_files[FIGURES_OPEN]; /* those whose `to` is not null */

/* DIR/NAME.csv; the caller writes the header line first. */
static inline FILE *figure_open(const char *dir, const char *name)
{
    int k = 0;
    while (k < FIGURES_OPEN && figure_files[k].to) k++;
    if (k == FIGURES_OPEN || !part_file_open(&figure_files[k], dir, name, "csv")) {
        fprintf(stderr, "cannot write %s/%s.csv: %s; does the folder exist and may you write there? (-figures names it)\n", dir, name,
                k == FIGURES_OPEN ? "too many figures at a time" : strerror(errno));
        exit(2);
    }
    return figure_files[k].to;
}
static inline void figure_close(FILE *out)
{
    int k = 0;
    while (figure_files[k].to != out) k++;
    if (!part_file_close(&figure_files[k])) {
        fprintf(stderr, "writing %s failed: %s; is the disk full?\n", figure_files[k].path, errno ? strerror(errno) : "unknown cause");
        exit(2);
    }
    figure_files[k].to = NULL;
}
/* Call it first: a folder that is missing or full is better known before the run than after it. The driver's
   name makes the file its own, because drivers run side by side. */
static inline void figure_folder(const char *dir, const char *driver)
{
    char name[64], path[PART_FILE_PATH];
    FILE *file;
    snprintf(name, sizeof name, "%.40s_folder", driver);
    file = figure_open(dir, name);
    fputs("x\n", file); /* an empty file fits on a full disk, too */
    figure_close(file);
    snprintf(path, sizeof path, "%s/%s.csv", dir, name);
    remove(path);
}

#endif
