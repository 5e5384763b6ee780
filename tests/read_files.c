/* SPDX-License-Identifier: MIT
 *
 * read_files FILE ... - reads what the examples write, without their code: .vtk (legacy, text or binary),
 * .vtu, .pvd and .csv, by the ending. Each file is a line of what it holds, or of what is wrong with it. The
 * status is 1 if anything is wrong.
 *
 *     drop_000.vtk: 3112 points, 3112 vertices, pressure 1, velocity 3
 *
 * Every point has to be a vertex of its own. Every array has to have a name of one word and finite numbers for
 * each point, every table as many fields in each line, and every series its files, in order of time.
 */
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAYS = 32, WORD = 256, DEPTH = 16 };

typedef struct content {
    char *text; /* of the whole file, with a 0 behind it */
    const char *at, *end;
    int binary;
    long points, vertices;
    int arrays, parts[ARRAYS];
    char name[ARRAYS][WORD], wrong[WORD]; /* wrong: what is, in words */
} content;

/* 0, and why */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static int
wrong(content *c, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    if (!c->wrong[0]) vsnprintf(c->wrong, sizeof c->wrong, format, values);
    va_end(values);
    return 0;
}
static int load(content *c, const char *path)
{
    FILE *const file = fopen(path, "rb");
    size_t size = 0, room = 1 << 16;
    c->text = file ? (char *)malloc(room) : NULL;
    while (c->text) {
        size += fread(c->text + size, 1, room - size, file);
        if (size < room) break;
        c->text = (char *)realloc(c->text, room *= 2);
    }
    if (file) fclose(file);
    if (!c->text) return wrong(c, "it cannot be read");
    c->text[size] = '\0';
    c->at = c->text;
    c->end = c->text + size;
    return 1;
}

/* ---- numbers and names ---- */

/* Big-endian, as legacy VTK has them, or text. */
static int number(content *c, double *value)
{
    uint64_t bits = 0;
    char *end;
    int k;
    if (!c->binary) {
        *value = strtod(c->at, &end);
        if (end == c->at || !strchr(" \t\n<", *end)) return wrong(c, "no number at '%.20s'", c->at);
        c->at = end;
    } else {
        if (c->end - c->at < 8) return wrong(c, "it is cut short");
        for (k = 0; k < 8; k++) bits = bits << 8 | (unsigned char)*c->at++;
        memcpy(value, &bits, sizeof bits);
    }
    return isfinite(*value) ? 1 : wrong(c, "a number is %g", *value);
}
static int numbers(content *c, long count)
{
    double value;
    while (count-- > 0)
        if (!number(c, &value)) return 0;
    return 1;
}
static int whole(content *c, long expected)
{
    double value;
    int32_t bits = 0;
    int k;
    if (!c->binary) {
        if (!number(c, &value)) return 0;
    } else {
        if (c->end - c->at < 4) return wrong(c, "it is cut short");
        for (k = 0; k < 4; k++) bits = (int32_t)((uint32_t)bits << 8 | (unsigned char)*c->at++);
        value = bits;
    }
    return value == (double)expected ? 1 : wrong(c, "%g in the place of %ld", value, expected);
}
static int array(content *c, const char *name, int parts)
{
    const char *s;
    int k;
    for (s = name; *s; s++)
        if (!isalnum((unsigned char)*s) && *s != '_') return wrong(c, "'%.100s' is not one word", name);
    if (!*name) return wrong(c, "an array without a name");
    for (k = 0; k < c->arrays; k++)
        if (strcmp(c->name[k], name) == 0) return wrong(c, "two arrays called %.100s", name);
    if (c->arrays == ARRAYS) return wrong(c, "too many arrays");
    strcpy(c->name[c->arrays], name);
    c->parts[c->arrays++] = parts;
    return 1;
}

/* ---- legacy VTK ---- */

static int word(content *c, char *into)
{
    int size = 0;
    c->at += strspn(c->at, " \t\n");
    while (*c->at && !strchr(" \t\n", *c->at) && size < WORD - 1) into[size++] = *c->at++;
    into[size] = '\0';
    return size > 0;
}
static int expect(content *c, const char *what)
{
    char found[WORD];
    word(c, found);
    return strcmp(found, what) == 0 ? 1 : wrong(c, "'%.60s' in the place of %s", found, what);
}
static int count(content *c, long *value)
{
    char found[WORD], *end;
    word(c, found);
    *value = strtol(found, &end, 10);
    return end > found && !*end && *value >= 0 ? 1 : wrong(c, "'%.60s' is no count", found);
}
static int line_end(content *c)
{
    return *c->at == '\n' ? (c->at++, 1) : wrong(c, "a line goes on with '%.20s'", c->at);
}
static int read_vtk(content *c)
{
    char key[WORD], name[WORD];
    long n = -1, i;
    if (strncmp(c->at, "# vtk DataFile Version ", 23) != 0) return wrong(c, "it is no VTK file");
    for (i = 0; i < 2; i++) { /* with a title */
        const char *const line = c->at;
        if (!(c->at = strchr(line, '\n')) || c->at - line > 255) return wrong(c, "its first lines");
        c->at++;
    }
    word(c, key);
    c->binary = strcmp(key, "BINARY") == 0;
    if (!c->binary && strcmp(key, "ASCII") != 0) return wrong(c, "neither ASCII nor BINARY");
    if (!expect(c, "DATASET") || !expect(c, "POLYDATA") || !expect(c, "POINTS") || !count(c, &c->points) ||
        !expect(c, "double") || !line_end(c) || !numbers(c, 3 * c->points))
        return 0;
    while (word(c, key)) {
        if (strcmp(key, "VERTICES") == 0) {
            if (!count(c, &c->vertices) || !count(c, &n) || n != 2 * c->vertices || !line_end(c))
                return wrong(c, "more in its vertices than points");
            for (i = 0; i < c->vertices; i++)
                if (!whole(c, 1) || !whole(c, i)) return 0;
        } else if (strcmp(key, "POINT_DATA") == 0) {
            if (!count(c, &n) || n != c->points) return wrong(c, "arrays of another size");
        } else if (strcmp(key, "SCALARS") == 0) {
            if (!word(c, name) || !expect(c, "double") || !expect(c, "1") || !line_end(c) ||
                !expect(c, "LOOKUP_TABLE") || !expect(c, "default") || !line_end(c) ||
                !numbers(c, c->points) || !array(c, name, 1))
                return 0;
        } else if (strcmp(key, "VECTORS") == 0) {
            if (!word(c, name) || !expect(c, "double") || !line_end(c) || !numbers(c, 3 * c->points) ||
                !array(c, name, 3))
                return 0;
        } else return wrong(c, "'%.60s', which is no keyword of POLYDATA", key);
    }
    return c->at == c->end ? 1 : wrong(c, "something follows");
}

/* ---- XML ---- */

/* The next tag: from behind its < to its >, without them; its name. 0: there is none. */
static int tag(content *c, const char **from, const char **to, char *name)
{
    size_t size;
    c->at += strspn(c->at, " \n");
    if (*c->at != '<' || !(*to = strchr(c->at, '>'))) return 0;
    *from = c->at + 1;
    size = strcspn(*from, " >");
    if (size >= WORD) return 0;
    memcpy(name, *from, size);
    name[size] = '\0';
    c->at = *to + 1;
    return 1;
}
/* The value of a tag's attribute; "": it has none. */
static const char *attribute(const char *from, const char *to, const char *name, char *value)
{
    const size_t length = strlen(name);
    size_t size = 0;
    for (; from + length + 2 < to; from++)
        if (*from == ' ' && strncmp(from + 1, name, length) == 0 &&
            strncmp(from + 1 + length, "=\"", 2) == 0) {
            from += length + 3;
            while (from < to && *from != '"' && size < WORD - 1) {
                if (*from == '&') {
                    value[size++] = (char)atoi(from + 2); /* &#38; */
                    from = strchr(from, ';');
                    if (!from) break;
                    from++;
                } else value[size++] = *from++;
            }
            break;
        }
    value[size] = '\0';
    return value;
}
static int data(content *c, const char *from, const char *to, const char *section)
{
    char name[WORD], text[WORD];
    long i, k;
    attribute(from, to, "Name", name);
    if (strcmp(attribute(from, to, "format", text), "ascii") != 0) return wrong(c, "format '%.60s'", text);
    if (strcmp(section, "Cells") == 0) {
        for (i = 0; i < c->points; i++) {
            const long expected = strcmp(name, "connectivity") == 0 ? i
                                  : strcmp(name, "offsets") == 0    ? i + 1
                                                                    : 1;
            if (!whole(c, expected)) return 0;
        }
        if (strcmp(name, "types") == 0) c->vertices = c->points; /* all are of type 1, a vertex */
        return 1;
    }
    k = atol(attribute(from, to, "NumberOfComponents", text));
    if (k != 1 && k != 3) return wrong(c, "%.60s has %ld components", name, k);
    if (strcmp(section, "Points") == 0)
        return k == 3 ? numbers(c, 3 * c->points) : wrong(c, "points of one component");
    if (strcmp(section, "PointData") != 0) return wrong(c, "an array in %.60s", section);
    return array(c, name, (int)k) && numbers(c, k * c->points);
}
/* folder: of the files of a series; a null pointer: it is one picture */
static int read_xml(content *c, const char *folder)
{
    static char open[DEPTH][WORD];
    char name[WORD], text[WORD], path[3 * WORD];
    const char *from, *to;
    double before = -HUGE_VAL;
    int depth = 0, whole_file = 0;
    if (strncmp(c->at, "<?xml version=\"1.0\"?>\n<VTKFile ", 31) != 0) return wrong(c, "it is no VTK file");
    c->at = strchr(c->at, '\n');
    while (tag(c, &from, &to, name)) {
        if (name[0] == '/') {
            if (depth == 0 || strcmp(name + 1, open[--depth]) != 0)
                return wrong(c, "<%.60s> ends nothing", name);
            whole_file = depth == 0;
            continue;
        }
        if (strcmp(name, "Piece") == 0) {
            c->points = atol(attribute(from, to, "NumberOfPoints", text));
            if (atol(attribute(from, to, "NumberOfCells", text)) != c->points)
                return wrong(c, "%s cells", text);
        } else if (strcmp(name, "DataArray") == 0) {
            if (depth == 0 || !data(c, from, to, open[depth - 1])) return wrong(c, "an array outside");
        } else if (strcmp(name, "DataSet") == 0) {
            const double time = strtod(attribute(from, to, "timestep", text), NULL);
            FILE *file;
            if (!folder || !*text || strspn(text, "0123456789.e+-") != strlen(text) || time <= before)
                return wrong(c, "timestep '%.60s'", text);
            before = time;
            if (snprintf(path, sizeof path, "%s/%s", folder, attribute(from, to, "file", text)) < 0 ||
                !(file = fopen(path, "rb")))
                return wrong(c, "no file '%.200s'", text);
            fclose(file);
            c->points++; /* in the sense of pictures */
        }
        if (to[-1] == '/') continue;
        if (depth == DEPTH) return wrong(c, "too deep");
        strcpy(open[depth++], name);
    }
    return whole_file && c->at == c->end ? 1 : wrong(c, "it goes on with '%.20s'", c->at);
}

/* ---- tables ---- */

static int read_csv(content *c)
{
    long fields = 1, expected = 0;
    int quoted = 0;
    for (; c->at < c->end; c->at++) {
        if (*c->at == '"') quoted = !quoted;
        else if (*c->at == '\r' || *c->at == '\0')
            return wrong(c, "line %ld has a line end of its own", c->points + 1);
        else if (*c->at == ',' && !quoted) fields++;
        else if (*c->at == '\n' && !quoted) {
            if (c->points++ == 0) expected = fields;
            if (fields != expected)
                return wrong(c, "line %ld has %ld fields, not %ld", c->points, fields, expected);
            fields = 1;
        }
    }
    return !quoted && c->points > 1 && c->end[-1] == '\n' ? 1
                                                          : wrong(c, "it has no lines, or no last line end");
}

static int read_file(const char *path)
{
    static content c;
    const char *const slash = strrchr(path, '/'), *const name = slash ? slash + 1 : path,
                      *const dot = strrchr(name, '.');
    const char *const ending = dot ? dot : "";
    char folder[WORD];
    int k, good;
    memset(&c, 0, sizeof c);
    snprintf(folder, sizeof folder, "%.*s", (int)(slash ? slash - path : 1), slash ? path : ".");
    good = load(&c, path);
    if (good && strcmp(ending, ".vtk") == 0) good = read_vtk(&c);
    else if (good && strcmp(ending, ".vtu") == 0) good = read_xml(&c, NULL);
    else if (good && strcmp(ending, ".pvd") == 0) good = read_xml(&c, folder);
    else if (good && strcmp(ending, ".csv") == 0) good = read_csv(&c);
    else if (good) good = wrong(&c, "it has an ending of no kind");
    free(c.text);
    if (good && (strcmp(ending, ".vtk") == 0 || strcmp(ending, ".vtu") == 0) &&
        (c.points < 1 || c.vertices != c.points || !c.arrays))
        good = wrong(&c, "%ld points, %ld vertices, %d arrays: nothing is drawn", c.points, c.vertices,
                     c.arrays);
    if (!good) {
        printf("%s: wrong: %s\n", path, c.wrong);
        return 0;
    }
    if (strcmp(ending, ".csv") == 0) printf("%s: %ld lines", path, c.points);
    else if (strcmp(ending, ".pvd") == 0) printf("%s: %ld pictures", path, c.points);
    else printf("%s: %ld points, %ld vertices", path, c.points, c.vertices);
    for (k = 0; k < c.arrays; k++) printf(", %s %d", c.name[k], c.parts[k]);
    printf("\n");
    return 1;
}
int main(int argc, char **argv)
{
    int k, bad = argc < 2;
    for (k = 1; k < argc; k++) bad |= !read_file(argv[k]);
    return bad;
}
