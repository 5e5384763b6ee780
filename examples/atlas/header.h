/* SPDX-License-Identifier: MIT
 *
 * header.h - what sph_ops.h says of an operator: the comment above its function, its signature, and its claims.
 *
 * A claim is a sentence of the comment of this form, with one of the words of the families:
 *     Atlas: gradient exact for linear fields; order 2 inside lattices, 1 in disorder, 1 at boundaries.
 *     Atlas: Hessian exact for linear fields, inside lattices for quadratic fields; order 0 inside lattices ...
 * `exact for` nothing, constants, linear, quadratic or cubic fields holds at every particle that has an answer:
 * in disorder, and at boundaries. An order is that of the root mean square of the error in the spacing dx, for
 * h / dx fixed: 0 does not fall, -1 grows.
 */
#ifndef ATLAS_HEADER_H
#define ATLAS_HEADER_H

#include "../common/host.h"

#include <ctype.h>

typedef struct header {
    char *text;  /* as it is */
    char *plain; /* with one space for each run of spaces, line ends and stars of comments */
} header;

typedef struct claim {
    int given, exact, exact_lattice, order[3]; /* inside lattices, in disorder, at boundaries */
    char text[240];
} claim;

static inline void header_squeeze(const char *from, char *to)
{
    int gap = 1, fresh = 0; /* fresh: at the start of a line, where a star belongs to the comment */
    for (; *from; from++) {
        if (isspace((unsigned char)*from) || (fresh && *from == '*')) {
            if (!gap) *to++ = ' ';
            gap = 1;
            if (*from == '\n') fresh = 1;
            continue;
        }
        fresh = 0;
        gap = 0;
        *to++ = *from;
    }
    *to = '\0';
}

/* All of a file, to be freed; null if it cannot be read. */
static inline char *file_text(const char *path)
{
    size_t size = 0, room = 1 << 16;
    FILE *const file = fopen(path, "rb");
    if (!file) return NULL;
    char *text = (char *)need(NULL, room, 1);
    for (size_t got; (got = fread(text + size, 1, room - size - 1, file)) > 0;) {
        size += got;
        if (room - size < 2) text = (char *)need(text, room *= 2, 1);
    }
    fclose(file);
    text[size] = '\0';
    return text;
}
static inline header header_read(const char *folder)
{
    header h;
    char path[1024];
    snprintf(path, sizeof path, "%s/sph_ops.h", folder);
    h.text = file_text(path);
    if (!h.text) {
        fprintf(stderr, "atlas: cannot read %s: run this in the repository's root, or name the folder by -headers\n", path);
        exit(2);
    }
    h.plain = (char *)need(NULL, strlen(h.text) + 1, 1);
    header_squeeze(h.text, h.plain);
    return h;
}
static inline void header_free(header *h)
{
    free(h->text);
    free(h->plain);
}

/* The definition of a function: where "SPH_FN type name(" starts; the end of its signature; and the comment above
   it, from slash to slash. Returns 0 if there is no such function. */
typedef struct passage {
    const char *from, *to;
} passage;
static inline int header_function(const header *h, const char *name, passage *comment, passage *signature)
{
    char text[128];
    snprintf(text, sizeof text, "\nSPH_FN sph_index %s(", name);
    const char *at = strstr(h->text, text);
    if (!at) return 0;
    signature->from = at + 1;
    signature->to = strchr(at, ')') + 1;
    comment->from = comment->to = at;
    if (at - h->text < 2 || at[-1] != '/' || at[-2] != '*') return 1;
    for (comment->from = at - 2; comment->from > h->text && strncmp(comment->from, "/*", 2) != 0;) comment->from--;
    return 1;
}

/* A word of a claim as a degree, or -2. */
static inline int header_degree(const char **at)
{
    static const char *const word[] = {"nothing", "constants", "linear fields", "quadratic fields", "cubic fields"};
    for (int d = 0; d < 5; d++)
        if (strncmp(*at, word[d], strlen(word[d])) == 0) {
            *at += strlen(word[d]);
            return d - 1;
        }
    return -2;
}
static inline const char *degree_text(int degree)
{
    static const char *const word[] = {"nothing", "constants", "linear fields", "quadratic fields", "cubic fields"};
    return word[degree + 1];
}
static inline int header_skip(const char **at, const char *text)
{
    const int there = strncmp(*at, text, strlen(text)) == 0;
    if (there) *at += strlen(text);
    return there;
}

/* The comment of a function, squeezed; to be freed. Null: there is no such function. */
static inline char *header_comment(const header *h, const char *function)
{
    passage comment, signature;
    if (!header_function(h, function, &comment, &signature)) return NULL;
    const size_t size = (size_t)(comment.to - comment.from);
    char *const text = (char *)need(NULL, size + 1, 1), *const plain = (char *)need(NULL, size + 1, 1);
    memcpy(text, comment.from, size);
    text[size] = '\0';
    header_squeeze(text, plain);
    free(text);
    return plain;
}

/* What a comment says outside of its claims: the next "exact for ..." from *at on, and 1; or 0. `where` is 1 if the
   sentence speaks of the interior or of lattices. */
static inline int header_phrase(const char **at, int *degree, int *where)
{
    static const char *const word[] = {"constant", "linear", "quadratic", "cubic"};
    for (const char *found; (found = strstr(*at, "xact for ")) != NULL;) {
        const char *from = found, *to = strchr(found, '.');
        if (!to) to = found + strlen(found);
        while (from > *at && *from != '.' && strncmp(from, "Atlas:", 6) != 0) from--;
        *at = found + strlen("xact for ");
        if (strncmp(from, "Atlas:", 6) == 0) continue;
        for (int d = 0; d < 4; d++)
            if (strncmp(*at, word[d], strlen(word[d])) == 0) {
                const char *const interior = strstr(found, "interior"), *const lattice = strstr(found, "lattice");
                *degree = d;
                *where = (interior && interior < to) || (lattice && lattice < to);
                return 1;
            }
    }
    return 0;
}

/* The claim of a comment about a family, if there is one; given is -1 where its words are not understood. */
static inline claim header_claim(const header *h, const char *function, const char *word)
{
    static const char *const where[3] = {" inside lattices", " in disorder", " at boundaries"};
    claim c;
    char start[64], *const plain = header_comment(h, function);
    memset(&c, 0, sizeof c);
    if (!plain) return c;
    snprintf(start, sizeof start, "Atlas: %s exact for ", word);
    const char *at = strstr(plain, start);
    if (at) {
        const char *const from = at;
        c.given = -1;
        at += strlen(start);
        c.exact = c.exact_lattice = header_degree(&at);
        if (header_skip(&at, ", inside lattices for ")) c.exact_lattice = header_degree(&at);
        int understood = c.exact > -2 && c.exact_lattice > -2 && header_skip(&at, "; order ");
        for (int k = 0; k < 3 && understood; k++) {
            char *end;
            c.order[k] = (int)strtol(at, &end, 10);
            understood = end > at;
            at = end;
            understood = understood && header_skip(&at, where[k]) && header_skip(&at, k < 2 ? ", " : ".");
        }
        if (understood) c.given = 1;
        snprintf(c.text, sizeof c.text, "%.*s", (int)(at - from), from);
    }
    free(plain);
    return c;
}

/* 1 if the text occurs in the header, in whatever lines. */
static inline int header_says(const header *h, const char *text) { return strstr(h->plain, text) != NULL; }

#endif
