/* SPDX-License-Identifier: MIT
 *
 * restart.h - a file from which a long run goes on, to the same numbers, bit for bit: DIR/NAME.restart. It is
 * written by part_file.h, so that a program that is killed at any moment leaves the last whole one.
 *
 *     static int transfer(restart *r, gas *g)              the same list of blocks for both directions
 *     {
 *         return restart_same(r, &g->model, sizeof g->model) && restart_block(r, g->x, n * sizeof *g->x) && ...;
 *     }
 *     restart r;
 *     if (!restart_write(&r, dir, name, "sph.h vortex 1") || !restart_end(&r, transfer(&r, g))) ... r.trouble
 *     switch (restart_read(&r, dir, name, "sph.h vortex 1")) {
 *     case 0: there is no such file
 *     case 1: if (!restart_end(&r, transfer(&r, g))) ... r.trouble; g holds what was read so far
 *     default: ... r.trouble
 *     }
 *
 * The program that reads has to be the one that wrote: blocks are bytes of memory.
 */
#ifndef RESTART_H
#define RESTART_H

#include "part_file.h"

#include <stdint.h>

enum { RESTART_MAGIC = 17 }; /* with the zero at its end */
#define RESTART_DAMAGED "it is cut short or damaged"
#define RESTART_FULL "is the disk full?"

typedef struct restart {
    part_file to; /* writing */
    FILE *file;
    int reads;
    uint64_t hash;
    long length; /* of the whole file that is read: no part of it asks for more memory */
    char trouble[256];
} restart;

/* Answers 0, so that a transfer may `return restart_trouble(...)`. */
static inline int restart_trouble(restart *r, const char *what)
{
    snprintf(r->trouble, sizeof r->trouble, "%s", what);
    return 0;
}
#define RESTART_EMPTY 14695981039346656037u
static inline uint64_t restart_hash(uint64_t hash, const void *block, size_t size) /* FNV-1a */
{
    const unsigned char *const byte = (const unsigned char *)block;
    size_t k;
    for (k = 0; k < size; k++) hash = (hash ^ byte[k]) * 1099511628211u;
    return hash;
}
/* Writes a block, or reads it. */
static inline int restart_block(restart *r, void *block, size_t size)
{
    if (size > 0 && (r->reads ? fread(block, 1, size, r->file) : fwrite(block, 1, size, r->file)) != size)
        return restart_trouble(r, r->reads ? RESTART_DAMAGED : RESTART_FULL);
    r->hash = restart_hash(r->hash, block, size);
    return 1;
}
/* Writes a block, or reads one and compares it: the numbers of a run that never change (bytes: no gaps). */
static inline int restart_same(restart *r, const void *block, size_t size)
{
    const unsigned char *const byte = (const unsigned char *)block;
    size_t k;
    for (k = 0; k < size; k++) {
        unsigned char there = byte[k];
        if (!restart_block(r, &there, 1)) return 0;
        if (there != byte[k]) return restart_trouble(r, "it belongs to a run with other parameters");
    }
    return 1;
}
static inline int restart_begin(restart *r, int reads, const char *magic)
{
    char text[RESTART_MAGIC] = "";
    snprintf(text, sizeof text, "%s", magic);
    r->reads = reads;
    r->hash = RESTART_EMPTY;
    if (restart_same(r, text, sizeof text)) return 1;
    return restart_trouble(r, reads ? "it is no restart of this program" : RESTART_FULL);
}
/* 1, or 0 with r->trouble. magic: name and version of the format, at most 16 characters. */
static inline int restart_write(restart *r, const char *dir, const char *name, const char *magic)
{
    r->trouble[0] = '\0';
    if (!part_file_open(&r->to, dir, name, "restart")) return restart_trouble(r, strerror(errno));
    r->file = r->to.to;
    if (restart_begin(r, 0, magic)) return 1;
    fclose(r->file);
    return 0;
}
/* 1; 0: there is no such file; -1: r->trouble says what is wrong with it. */
static inline int restart_read(restart *r, const char *dir, const char *name, const char *magic)
{
    char path[PART_FILE_PATH];
    r->trouble[0] = '\0';
    if (snprintf(path, sizeof path, "%s/%s.restart", dir, name) >= (int)sizeof path ||
        !(r->file = fopen(path, "rb")))
        return 0;
    if (fseek(r->file, 0, SEEK_END) != 0 || (r->length = ftell(r->file)) < 0 ||
        fseek(r->file, 0, SEEK_SET) != 0)
        restart_trouble(r, "it cannot be read");
    else if (restart_begin(r, 1, magic)) return 1;
    fclose(r->file);
    return -1;
}
/* After the blocks; whole: the answer of the transfer. 1: the file is whole, and has its name. */
static inline int restart_end(restart *r, int whole)
{
    uint64_t hash = r->hash;
    if (whole &&
        (r->reads ? fread(&hash, sizeof hash, 1, r->file) : fwrite(&hash, sizeof hash, 1, r->file)) != 1)
        whole = restart_trouble(r, r->reads ? RESTART_DAMAGED : RESTART_FULL);
    if (whole && hash != r->hash) whole = restart_trouble(r, RESTART_DAMAGED);
    if (r->reads || !whole) {
        fclose(r->file);
        return whole;
    }
    return part_file_close(&r->to) || restart_trouble(r, strerror(errno));
}

#endif
