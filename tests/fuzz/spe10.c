/* SPDX-License-Identifier: MIT */
/*
 * spe10.c - fuzz target: the reader of SPE10's permeability files (examples/papers/elliptic_reference.h), on the bytes as they are and on files of the right length, text or float32, that the bytes spoil in a
 * few places. It must refuse, with a message, or give a field of positive numbers.
 */
#define _POSIX_C_SOURCE 200809L /* mkstemp, ftruncate */
#include "fuzz.h"

#include "../../examples/papers/elliptic_reference.h"

#include <unistd.h>

/* one file for all inputs, in the temporary folder; removed at the end */
static char path[256];
static void remove_file(void) { remove(path); }
static FILE *open_file(void)
{
    FILE *file;
    if (!path[0]) {
        const char *const folder = getenv("TMPDIR");
        int f;
        if (snprintf(path, sizeof path, "%.200s/fuzz_spe10_XXXXXX", folder ? folder : "/tmp") < 0 || (f = mkstemp(path)) < 0) exit(1);
        close(f);
        atexit(remove_file);
    }
    file = fopen(path, "wb");
    if (!file) exit(1);
    return file;
}

/* `count` numbers, as text or as float32, the last of them and some others spoilt by the input's bytes */
static void write_model(fuzz_input *in, int text, int count)
{
    enum { WIDTH = 4 }; /* bytes of a number, of either kind */
    static char model[2][WIDTH * (ELLIPTIC_BLOCK + 1)];
    const size_t size = WIDTH * (size_t)count;
    char *const m = model[text];
    const int spoilt = fuzz_below(in, 4);
    FILE *const file = open_file();
    size_t at[4];
    int s, k;
    if (!m[3])
        for (k = 0; k <= ELLIPTIC_BLOCK; k++) memcpy(m + WIDTH * k, text ? (k % 7 ? "5e0 " : "1e2\n") : "\0\0\x80\x3f", WIDTH); /* float32: 1 */
    for (s = 0; s < spoilt; s++) {
        at[s] = fuzz_bits(in, 3) % size;
        m[at[s]] = fuzz_below(in, 2) ? "0-.eE+ x"[fuzz_below(in, 8)] : (char)fuzz_byte(in);
    }
    fwrite(m, 1, size - (size_t)fuzz_below(in, 3) / 2, file);
    fclose(file);
    for (s = 0; s < spoilt; s++) { /* whole again for the next input */
        k = (int)(at[s] / WIDTH);
        memcpy(m + WIDTH * k, text ? (k % 7 ? "5e0 " : "1e2\n") : "\0\0\x80\x3f", WIDTH);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    const int how = fuzz_below(&in, 8), dim = 2 + fuzz_below(&in, 2);
    char message[ELLIPTIC_MESSAGE];
    elliptic_field field;
    int answer, a;
    if (how > 0) {
        FILE *const file = open_file();
        fwrite(in.data, 1, in.left, file);
        fclose(file);
    } else write_model(&in, dim == 2, (dim == 2 ? ELLIPTIC_LAYER : ELLIPTIC_BLOCK) + fuzz_below(&in, 9) / 8);
    answer = elliptic_spe10_read(path, dim, &field, message);
    FUZZ_REQUIRE(answer == 0 || answer == -1);
    FUZZ_REQUIRE((answer == 0) == (message[0] == '\0') && memchr(message, '\0', sizeof message) != NULL);
    if (answer == 0) {
        const int cells = elliptic_cells(field.n);
        FUZZ_REQUIRE(cells == (dim == 2 ? 3600 : 216000) && memchr(field.source, '\0', sizeof field.source) != NULL);
        for (a = 0; a < 3; a++) {
            int i;
            for (i = 0; i < cells; i++) FUZZ_REQUIRE(field.k[a][i] > 0.0 && isfinite(field.k[a][i]));
        }
        FUZZ_REQUIRE(elliptic_contrast(&field) >= 1.0);
    }
    elliptic_field_free(&field);
    return 0;
}
