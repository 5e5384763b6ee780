/* SPDX-License-Identifier: MIT */
/*
 * restart.c - fuzz target: the restart files of examples/papers/cleaning_collapse, as the input spoils one that was saved: cut short, bytes changed, its checksum put right again. Reading must refuse, with a
 * reason, or give the numbers that are in the file.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "fuzz.h"

#include "../../examples/papers/collapse.h"

#include <unistd.h>

enum { N = 20, MORE = 24 };
static char folder[64], path[128];
static unsigned char *saved;
static size_t saved_size;

static void remove_files(void)
{
    remove(path);
    rmdir(folder);
}

static collapse make(void)
{
    collapse g;
    collapse_model model;
    memset(&model, 0, sizeof model);
    model.m = 1.0;
    collapse_new(&g, &model, N);
    g.s.n = N;
    return g;
}

static void save_one(void)
{
    const char *const temporary = getenv("TMPDIR");
    unsigned char more[MORE] = {1, 2, 3};
    collapse g = make();
    FILE *file;
    int k, i;
    snprintf(folder, sizeof folder, "%.40s/fuzz_restart_XXXXXX", temporary ? temporary : "/tmp");
    if (!mkdtemp(folder)) exit(1);
    snprintf(path, sizeof path, "%s/r.restart", folder);
    atexit(remove_files);
    for (k = 0; k < ARRAYS; k++)
        for (i = 0; i < N; i++) g.a[k][i] = k + 0.01 * i;
    FUZZ_REQUIRE(collapse_save(&g, folder, "r", more, sizeof more));
    collapse_free(&g);
    file = fopen(path, "rb");
    saved = (unsigned char *)fuzz_memory(1 << 20, 1);
    if (!file || (saved_size = fread(saved, 1, 1 << 20, file)) == 0) exit(1);
    fclose(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    unsigned char *spoilt;
    size_t length, more_size = 0;
    int how, changes;
    void *more = NULL;
    collapse g;
    FILE *file;
    if (!saved) save_one();
    how = fuzz_below(&in, 4);
    spoilt = (unsigned char *)fuzz_memory(2 * saved_size, 1);
    memset(spoilt, 0, 2 * saved_size);
    memcpy(spoilt, saved, saved_size);
    length = saved_size;
    if (how == 0) length = fuzz_bits(&in, 2) % (saved_size + 1);
    for (changes = fuzz_below(&in, 8); changes > 0; changes--) { /* anywhere, or in what comes before the arrays */
        const size_t at = fuzz_below(&in, 2) ? fuzz_bits(&in, 2) % saved_size : RESTART_MAGIC + sizeof(collapse_model) + fuzz_bits(&in, 2) % (8 + sizeof(collapse_state));
        spoilt[at] = (unsigned char)fuzz_byte(&in);
    }
    if (how >= 2) { /* as if it had been written like that: as long as its numbers say, with the right checksum */
        const size_t start = RESTART_MAGIC + sizeof(collapse_model);
        uint64_t hash, size_of_more = 0;
        sph_index n = 0;
        if (fuzz_below(&in, 2)) n = (sph_index)(fuzz_below(&in, 2 * N) - 2), memcpy(spoilt + start + 8 + offsetof(collapse_state, n), &n, sizeof n);
        memcpy(&size_of_more, spoilt + start, 8);
        memcpy(&n, spoilt + start + 8 + offsetof(collapse_state, n), sizeof n);
        length = start + 8 + sizeof(collapse_state) + (size_t)(n > 0 && n < 2 * N ? n : N) * (ARRAYS + EVOLVED) * sizeof(double) + (size_t)(size_of_more < MORE ? size_of_more : MORE) + 8;
        hash = restart_hash(RESTART_EMPTY, spoilt, length - 8);
        memcpy(spoilt + length - 8, &hash, 8);
    }
    file = fopen(path, "wb");
    if (!file || fwrite(spoilt, 1, length, file) != length || fclose(file) != 0) exit(1);
    g = make();
    how = collapse_load(&g, folder, "r", &more, &more_size);
    FUZZ_REQUIRE(how == 1 || (how == -1 && g.trouble[0]));
    if (length == saved_size && memcmp(spoilt, saved, saved_size) == 0) FUZZ_REQUIRE(how == 1 && more_size == MORE);
    if (how == 1) FUZZ_REQUIRE(g.s.n >= 1 && g.s.n <= N && (more_size == 0 || more) && !g.trouble[0]);
    free(more);
    free(spoilt);
    collapse_free(&g);
    return 0;
}
