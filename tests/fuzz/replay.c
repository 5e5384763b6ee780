/* SPDX-License-Identifier: MIT */
/* replay.c - main for a fuzz target without a fuzzer: runs the files that are named, or standard input. */
#include "fuzz.h"

static void run(FILE *file, const char *name)
{
    size_t room = 4096, size = 0;
    uint8_t *data = NULL, *exact;
    for (;;) {
        uint8_t *const more = (uint8_t *)realloc(data, room);
        if (!more) exit(1);
        data = more;
        size += fread(data + size, 1, room - size, file);
        if (size < room) break;
        room *= 2;
    }
    if (ferror(file)) {
        perror(name);
        exit(1);
    }
    exact = (uint8_t *)fuzz_memory(size, 1); /* so that reading beyond the input is seen, too */
    if (size > 0) memcpy(exact, data, size);
    free(data);
    fprintf(stderr, "%s\n", name);
    LLVMFuzzerTestOneInput(exact, size);
    free(exact);
}

int main(int argc, char **argv)
{
    int i;
    if (argc < 2) run(stdin, "standard input");
    for (i = 1; i < argc; i++) {
        FILE *const file = fopen(argv[i], "rb");
        if (!file) {
            perror(argv[i]);
            return 1;
        }
        run(file, argv[i]);
        fclose(file);
    }
    return 0;
}
