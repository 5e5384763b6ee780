/* SPDX-License-Identifier: MIT
 *
 * part_file.h - a file that gets its name when it is whole: it is written as NAME.part and then renamed, so that a program that is stopped at any moment leaves the old file or the new one, never half of one.
 *
 *     part_file f;
 *     if (!part_file_open(&f, "build/results", "run", "csv")) ...      run.csv.part
 *     fprintf(f.to, ...);
 *     if (!part_file_close(&f)) ...                                    run.csv
 *
 * Both return 0 and leave the cause in errno if the file cannot be written, else 1.
 */
#ifndef PART_FILE_H
#define PART_FILE_H

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { PART_FILE_PATH = 4096 };

typedef struct part_file {
    FILE *to; /* write here */
    char path[PART_FILE_PATH], part[PART_FILE_PATH];
} part_file;

/* dir/name.ending */
static inline int part_file_open(part_file *f, const char *dir, const char *name, const char *ending)
{
    const int length = snprintf(f->part, sizeof f->part, "%s/%s.%s.part", dir, name, ending);
    f->to = NULL;
    f->path[0] = '\0';
    errno = ENAMETOOLONG;
    if (length < 0 || (size_t)length >= sizeof f->part) return 0;
    strcpy(f->path, f->part);
    f->path[length - (int)strlen(".part")] = '\0';
    errno = 0;
    f->to = fopen(f->part, "wb"); /* restarts are binary */
    return f->to != NULL;
}

static inline int part_file_close(part_file *f)
{
    const int broken = ferror(f->to) != 0;
    if (fclose(f->to) != 0 || broken) return 0;
    /* C leaves open whether rename replaces a file: where it does not, the old one has to go first */
    return rename(f->part, f->path) == 0 || (remove(f->path), rename(f->part, f->path) == 0);
}

#endif
