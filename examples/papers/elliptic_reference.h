/* SPDX-License-Identifier: MIT */
/*
 * elliptic_reference.h - what the drivers of the elliptic paper compare with: exact series, the two-point flux scheme and a mimetic scheme on cells, the
 * permeability of SPE10 from a file, and made-up fields of the same kind where there is no file.
 *
 * The paper is A. A. Lukyanov, C. Vuik, arXiv:1711.11351; numbers in brackets are its equations. Section 5 solves div(M grad u) = 0 on a rectangle or a box.
 */
#ifndef ELLIPTIC_REFERENCE_H
#define ELLIPTIC_REFERENCE_H

#include <errno.h>
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../common/figure.h"
#include "../common/number.h"
#include "../common/random.h"
#include "../common/sparse.h"

/* ---- exact solutions --------------------------------------------------- */

/* 1 - exp(-2 a); from a = 20 on it rounds to 1 */
static inline double elliptic_rest(double a) { return a > 20.0 ? 1.0 : -expm1(-2.0 * a); }
/* sinh(a)/sinh(b) and cosh(a)/sinh(b) for 0 <= a <= b, b > 0: the functions themselves overflow from 710 on, which is n = 226 for a square. */
static inline double elliptic_sinh_ratio(double a, double b) { return a - b < -50.0 ? 0.0 : exp(a - b) * (elliptic_rest(a) / elliptic_rest(b)); }
static inline double elliptic_cosh_ratio(double a, double b) { return a - b < -50.0 ? 0.0 : exp(a - b) * ((2.0 - elliptic_rest(a)) / elliptic_rest(b)); }

/* sin(n a) for n = first, first - 2, ...: a rotation each, which takes less time than a sine and adds a rounding. Almost all
 * of the time of a series would be that of its sines. */
typedef struct elliptic_sines {
    double s, c, turn_s, turn_c; /* s is the value */
} elliptic_sines;
static inline elliptic_sines elliptic_sines_from(double first, double a)
{
    elliptic_sines now = {sin(first * a), cos(first * a), sin(2.0 * a), cos(2.0 * a)};
    return now;
}
static inline void elliptic_sines_next(elliptic_sines *now)
{
    const double s = now->s;
    now->s = s * now->turn_c - now->c * now->turn_s;
    now->c = now->c * now->turn_c + s * now->turn_s;
}

/* (96): u on the rectangle 0 <= x <= L, 0 <= y <= H with u = psi[0], psi[1], psi[2], psi[3] on the sides y = 0, x = L, y = H, x = 0; `terms` odd n from 1 on.
 * As printed, the third term repeats the second; it is sin(n pi x/L) sinh(n pi y/L) / sinh(n pi H/L). The paper's tables have 100 terms, and at 160 x 160 cells
 * what is left out of the series is most of their error. */
static inline double elliptic_series_dirichlet(double x, double y, double L, double H, const double psi[4], int terms)
{
    elliptic_sines sx = elliptic_sines_from(2.0 * terms - 1.0, x * MATH_PI / L), sy = elliptic_sines_from(2.0 * terms - 1.0, y * MATH_PI / H);
    double u = 0.0;
    for (int k = terms - 1; k >= 0; --k) { /* small terms first */
        const double n = 2.0 * k + 1.0, p = n * MATH_PI / L, q = n * MATH_PI / H;
        const double across = psi[0] * elliptic_sinh_ratio(p * (H - y), p * H) + psi[2] * elliptic_sinh_ratio(p * y, p * H);
        const double along = psi[1] * elliptic_sinh_ratio(q * x, q * L) + psi[3] * elliptic_sinh_ratio(q * (L - x), q * L);
        u += 4.0 / (n * MATH_PI) * (sx.s * across + sy.s * along);
        elliptic_sines_next(&sx);
        elliptic_sines_next(&sy);
    }
    return u;
}

/* (98): u = psi[0] on y = 0; outward derivatives psi[1], psi[2], psi[3] on x = L, y = H, x = 0; n = 1 ... terms. As printed the last factor is sinh(lambda_n
 * y); it is sin. The paper's text has psi_3 = 150; its tables 6 and 7 were made with 100. */
static inline double elliptic_series_mixed(double x, double y, double L, double H, const double psi[4], int terms)
{
    elliptic_sines sy = elliptic_sines_from(2.0 * terms - 1.0, y * MATH_PI / (2.0 * H));
    double u = 0.0;
    for (int n = terms; n >= 1; --n) {
        const double lambda = (2.0 * n - 1.0) * MATH_PI / (2.0 * H);
        const double along = psi[1] * elliptic_cosh_ratio(lambda * x, lambda * L) + psi[3] * elliptic_cosh_ratio(lambda * (L - x), lambda * L);
        u += 2.0 * along / (H * lambda * lambda) * sy.s;
        elliptic_sines_next(&sy);
    }
    return psi[0] + psi[2] * y + u;
}

/* (95) for equal volumes: sqrt(mean(((u - uh)/u)^2)). What tables 2 to 9 print is 100/N of it, N being the particles along a side. */
static inline double elliptic_relative_error(int64_t n, const double *exact, const double *approximate)
{
    double sum = 0.0;
    for (int64_t k = 0; k < n; ++k) {
        const double e = (exact[k] - approximate[k]) / exact[k];
        sum += e * e;
    }
    return sqrt(sum / (double)n);
}

static inline double elliptic_printed_error(double relative_error, int side) { return 100.0 / side * relative_error; }

/* ---- two-point fluxes -------------------------------------------------- */

typedef struct elliptic_side {
    int dirichlet; /* u = value; otherwise the outward flux M du/dn = value, so that all zeros mean: nothing flows */
    double value;
} elliptic_side;

/* A box of n[0] x n[1] x n[2] cells, the first index fastest. In two dimensions n[2] = 1, size[2] = 1 and nothing flows along the third axis. */
typedef struct elliptic_box {
    int n[3];
    double size[3];           /* of a cell */
    const double *k[3];       /* M along each axis, one value a cell; NULL: 1. The same array may stand for all */
    elliptic_side side[3][2]; /* [axis][0: low end, 1: high end] */
} elliptic_box;

static inline elliptic_box elliptic_square(int n, elliptic_side y_low, elliptic_side x_high, elliptic_side y_high, elliptic_side x_low)
{
    elliptic_box box;
    memset(&box, 0, sizeof box);
    box.n[0] = box.n[1] = n;
    box.n[2] = 1;
    box.size[0] = box.size[1] = 1.0 / n;
    box.size[2] = 1.0;
    box.side[0][0] = x_low;
    box.side[0][1] = x_high;
    box.side[1][0] = y_low;
    box.side[1][1] = y_high;
    return box;
}

/* The settings of tables 2 to 5 and 6 to 9 on N x N cells. */
static const double elliptic_psi_dirichlet[4] = {100.0, 90.0, 150.0, 200.0};
static const double elliptic_psi_mixed[4] = {150.0, 90.0, 100.0, 200.0};

static inline elliptic_box elliptic_square_of(int n, int mixed)
{
    const double *psi = mixed ? elliptic_psi_mixed : elliptic_psi_dirichlet;
    elliptic_side s[4];
    for (int k = 0; k < 4; ++k) {
        s[k].dirichlet = k == 0 || !mixed;
        s[k].value = psi[k];
    }
    return elliptic_square(n, s[0], s[1], s[2], s[3]);
}

/* The series at the centres of N x N cells of the unit square, first index fastest. */
static inline void elliptic_square_exact(int n, int mixed, int terms, double *u)
{
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double x = (i + 0.5) / n, y = (j + 0.5) / n;
            u[(size_t)j * (size_t)n + (size_t)i] = mixed ? elliptic_series_mixed(x, y, 1.0, 1.0, elliptic_psi_mixed, terms)
                                                         : elliptic_series_dirichlet(x, y, 1.0, 1.0, elliptic_psi_dirichlet, terms);
        }
}

/* Number of cells; -1 if that is no number of unknowns. */
static inline int elliptic_cells(const int n[3])
{
    if (n[0] < 1 || n[1] < 1 || n[2] < 1) return -1;
    const double cells = (double)n[0] * n[1] * n[2];
    return cells <= INT_MAX ? n[0] * n[1] * n[2] : -1;
}

/* (66)-(67): for every cell, sum over its faces of T (u - u of the other side) = what flows in from outside, where T is the harmonic mean of both half cells
 * and a Dirichlet face has the half cell of its own. A is symmetric with positive diagonal. Returns 0; -1 without memory; -2 for a box that is none, or an M
 * that is not positive. Then A is empty. b: one place a cell */
static inline int elliptic_tpfa(const elliptic_box *box, sparse *A, double *b)
{
    const int cells = elliptic_cells(box->n);
    int bad = cells < 0;
    sparse_builder build;
    memset(A, 0, sizeof *A);
    for (int axis = 0; axis < 3 && !bad; ++axis) {
        if (!(box->size[axis] > 0.0)) bad = 1;
        for (int c = 0; c < cells && box->k[axis]; ++c)
            if (!(box->k[axis][c] > 0.0 && box->k[axis][c] <= DBL_MAX)) bad = 1;
    }
    if (bad) return -2;

    const int stride[3] = {1, box->n[0], box->n[0] * box->n[1]};
    const double volume = box->size[0] * box->size[1] * box->size[2];
    sparse_begin(&build, cells, 7 * (int64_t)cells);
    for (int c = 0; c < cells; ++c) {
        const int place[3] = {c % box->n[0], c / stride[1] % box->n[1], c / stride[2]};
        double diagonal = 0.0;
        b[c] = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double face = volume / box->size[axis], half = 0.5 * box->size[axis];
            const double *k = box->k[axis];
            const double inside = half / (face * (k ? k[c] : 1.0)); /* resistance from the centre to the face */
            for (int end = 0; end < 2; ++end) {
                const elliptic_side *side = &box->side[axis][end];
                const int at_side = place[axis] == (end ? box->n[axis] - 1 : 0), other = c + (end ? stride[axis] : -stride[axis]);
                double T = 0.0;
                if (!at_side) {
                    T = 1.0 / (inside + half / (face * (k ? k[other] : 1.0)));
                    sparse_put(&build, other, -T);
                } else if (side->dirichlet) {
                    T = 1.0 / inside;
                    b[c] += T * side->value;
                } else {
                    b[c] += face * side->value;
                }
                diagonal += T;
            }
        }
        sparse_put(&build, c, diagonal);
        sparse_end_row(&build);
    }
    return sparse_finish(&build, A);
}

/* ---- a mimetic scheme -------------------------------------------------- */

/*
 * The hybrid mimetic finite difference method on N x N square cells with M = 1, with the inner product that the MATLAB Reservoir Simulation Toolbox calls
 * `ip_simple` (K.-A. Lie, An Introduction to Reservoir Simulation Using MATLAB/GNU Octave, Cambridge 2019, section 6.4; F. Brezzi, K. Lipnikov, V. Simoncini,
 * Math. Models Methods Appl. Sci. 15 (2005) 1533). The outward fluxes of a cell are q = W (u_cell - u_faces) with
 *     W = (N N^T + 6 D (1 - Q Q^T) D) / volume,
 * N: face normals times areas, D: areas, Q: orthonormal basis of D times (face centre - cell centre). In a square that is [4 2; 2 4] for each pair of opposite
 * faces. The fluxes of a cell add up to 0 (nothing else is in (1) here), so that u_cell is the mean of its faces and q = -(W - 3/2) u_faces; the unknowns are
 * the faces, each of which says that the flux of one cell enters the other.
 */

/* Faces across the first axis come first: face i of 0 ... n in row j is j (n + 1) + i; then those across the second, face j of 0 ... n in column i: j n + i. */
static inline int elliptic_mimetic_faces(int n) { return 2 * n * (n + 1); }

/* Faces of the cell (i, j): low and high across the first axis, low and high across the second. */
static inline void elliptic_mimetic_faces_of(int n, int i, int j, int face[4])
{
    face[0] = j * (n + 1) + i;
    face[1] = face[0] + 1;
    face[2] = n * (n + 1) + j * n + i;
    face[3] = face[2] + n;
}

/* The equation of one face of a box made by elliptic_square. */
static inline double elliptic_mimetic_row(sparse_builder *build, const elliptic_box *box, int f)
{
    const int n = box->n[0], axis = f >= n * (n + 1), g = f - (axis ? n * (n + 1) : 0);
    const int along = axis ? g / n : g % (n + 1), across = axis ? g % n : g / (n + 1); /* which face of a line of cells, which line */
    const elliptic_side *side = along == 0 ? &box->side[axis][0] : along == n ? &box->side[axis][1] : NULL;
    if (side && side->dirichlet) {
        sparse_put(build, f, 1.0);
        return side->value;
    }
    for (int cell = along - 1; cell <= along; ++cell) {
        if (cell < 0 || cell >= n) continue;
        int face[4];
        elliptic_mimetic_faces_of(n, axis ? across : cell, axis ? cell : across, face);
        for (int m = 0; m < 4; ++m) {
            const int opposite = face[m] != f && m / 2 == axis;
            sparse_put(build, face[m], (face[m] == f ? 4.0 : opposite ? 2.0 : 0.0) - 1.5);
        }
    }
    return side ? side->value * box->size[0] : 0.0;
}

/* Returns 0; -1 without memory, -2 for a box that is not of N x N squares with M = 1. b: elliptic_mimetic_faces(n) places */
static inline int elliptic_mimetic(const elliptic_box *box, sparse *A, double *b)
{
    const int n = box->n[0];
    sparse_builder build;
    memset(A, 0, sizeof *A);
    if (n < 1 || n > 30000 || box->n[1] != n || box->n[2] != 1 || box->size[0] != box->size[1] || box->k[0] || box->k[1]) return -2;
    sparse_begin(&build, elliptic_mimetic_faces(n), 7 * (int64_t)elliptic_mimetic_faces(n));
    for (int f = 0; f < elliptic_mimetic_faces(n); ++f) {
        b[f] = elliptic_mimetic_row(&build, box, f);
        sparse_end_row(&build);
    }
    return sparse_finish(&build, A);
}

static inline void elliptic_mimetic_cells(int n, const double *faces, double *cells)
{
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            int f[4];
            elliptic_mimetic_faces_of(n, i, j, f);
            cells[j * n + i] = 0.25 * (faces[f[0]] + faces[f[1]] + faces[f[2]] + faces[f[3]]);
        }
}

/* ---- permeability ------------------------------------------------------ */

/* A field on n[0] x n[1] x n[2] cells, the first index fastest. Along an axis of which nothing is known k[axis] is k[0]. */
typedef struct elliptic_field {
    int n[3];
    double *k[3];
    double *memory;
    char source[256]; /* where it comes from, in words */
} elliptic_field;

static inline void elliptic_field_free(elliptic_field *field)
{
    free(field->memory);
    memset(field, 0, sizeof *field);
}

/* Room for `components` arrays (1 or 3). Returns 0 without memory. */
static inline int elliptic_field_open(elliptic_field *field, int n0, int n1, int n2, int components)
{
    memset(field, 0, sizeof *field);
    field->n[0] = n0;
    field->n[1] = n1;
    field->n[2] = n2;
    const int cells = elliptic_cells(field->n);
    field->memory = cells < 0 ? NULL : (double *)sparse_memory((int64_t)cells * components, sizeof(double));
    for (int axis = 0; axis < 3 && field->memory; ++axis) field->k[axis] = field->memory + (components == 3 ? (size_t)axis * (size_t)cells : 0);
    return field->memory != NULL;
}

/* Largest over smallest value along the first axis. */
static inline double elliptic_contrast(const elliptic_field *field)
{
    const int cells = elliptic_cells(field->n);
    double least = HUGE_VAL, most = 0.0;
    for (int c = 0; c < cells; ++c) {
        least = fmin(least, field->k[0][c]);
        most = fmax(most, field->k[0][c]);
    }
    return most / least;
}

/*
 * SPE10 model 2: M. A. Christie, M. J. Blunt, SPE Reservoir Eval. Eng. 4 (2001) 308; 60 x 220 x 85 cells of 20 x 10 x 2 ft. Three kinds of files are known by
 * what is in them:
 *     spe_perm.dat as it is published: text, 3 x 60 x 220 x 85 numbers, all of Kx, then Ky, then Kz;
 *     text of 60 x 220 numbers: Kx of one layer;
 *     60 x 60 x 60 little-endian float32: Kx of that corner of the model.
 * In all of them i is fastest, then j, then k. The paper takes i, j = 1 ... 60 of layer 85 (two dimensions) or i, j, k = 1 ... 60 (three).
 */
enum {
    ELLIPTIC_I = 60,
    ELLIPTIC_J = 220,
    ELLIPTIC_K = 85,
    ELLIPTIC_SIDE = 60,
    ELLIPTIC_LAYER = ELLIPTIC_I * ELLIPTIC_J,
    ELLIPTIC_MODEL = ELLIPTIC_LAYER * ELLIPTIC_K
};
enum { ELLIPTIC_BLOCK = ELLIPTIC_SIDE * ELLIPTIC_SIDE * ELLIPTIC_SIDE, ELLIPTIC_MESSAGE = 256 };

/* The whole file, with a '\0' behind it; NULL with a message if that cannot be had. The model's file has some 50 MB. */
static inline char *elliptic_file(const char *path, size_t *size, char message[ELLIPTIC_MESSAGE])
{
    const size_t most = (size_t)256 << 20;
    size_t room = (size_t)1 << 20;
    char *text = NULL;
    errno = 0;
    *size = 0;
    message[0] = '\0';
    FILE *file = fopen(path, "rb");
    if (!file) {
        snprintf(message, ELLIPTIC_MESSAGE, "cannot open '%.120s': %s", path, errno ? strerror(errno) : "unknown cause");
        return NULL;
    }
    for (;;) {
        char *larger = room <= most ? (char *)realloc(text, room + 1) : NULL;
        if (!larger) {
            snprintf(message, ELLIPTIC_MESSAGE, room <= most ? "not enough memory for '%.120s'" : "'%.120s' is larger than any file of SPE10", path);
            break;
        }
        text = larger;
        *size += fread(text + *size, 1, room - *size, file);
        if (*size < room) break;
        room *= 2;
    }
    if (ferror(file)) snprintf(message, ELLIPTIC_MESSAGE, "cannot read '%.120s': %s", path, errno ? strerror(errno) : "unknown cause");
    fclose(file);
    if (message[0]) {
        free(text);
        return NULL;
    }
    text[*size] = '\0';
    return text;
}

/* Only what numbers and the space between them are made of? */
static inline int elliptic_is_text(const char *text, size_t size)
{
    for (size_t k = 0; k < size; ++k)
        if (!text[k] || !strchr("0123456789.+-eE \t\r\n", text[k])) return 0;
    return 1;
}

/* The numbers of a text, at most `room` of them; returns how many there are, or -1 where one is spoilt, with its number (from 1) in *spoilt. */
static inline int64_t elliptic_numbers(const char *text, double *value, int64_t room, int64_t *spoilt)
{
    int64_t count = 0;
    for (;;) {
        const char *end;
        text += strspn(text, " \t\r\n");
        if (!*text) return count;
        const double number = number_of(text, &end);
        if (end == text || !strchr(" \t\r\n", *end)) { /* finds '\0' too */
            *spoilt = count + 1;
            return -1;
        }
        if (count < room) value[count] = number;
        ++count;
        text = end;
    }
}

/* A float32 from its four bytes in little-endian order, whatever the machine's own. */
static inline double elliptic_float32(const char *bytes)
{
    uint32_t bits = 0;
    for (int k = 3; k >= 0; --k) bits = bits << 8 | (unsigned char)bytes[k];
    const int exponent = (int)(bits >> 23 & 0xff);
    const double fraction = (double)(bits & 0x7fffff) / 8388608.0, sign = bits >> 31 ? -1.0 : 1.0;
    if (exponent == 0xff) return (double)NAN; /* or infinite: nothing that a permeability can be */
    return sign * ldexp(exponent ? 1.0 + fraction : fraction, (exponent ? exponent : 1) - 127);
}

/* The values of a file and how many components, rows (j) and layers they have. Returns NULL with a message. */
static inline double *elliptic_spe10_values(const char *path, int *components, int *rows, int *layers, char message[ELLIPTIC_MESSAGE])
{
    size_t size;
    char *text = elliptic_file(path, &size, message);
    if (!text) return NULL;
    const int is_text = elliptic_is_text(text, size), is_block = !is_text && size == 4 * (size_t)ELLIPTIC_BLOCK;
    double *value = is_text || is_block ? (double *)sparse_memory(is_block ? ELLIPTIC_BLOCK : 3 * (int64_t)ELLIPTIC_MODEL, sizeof *value) : NULL;
    int64_t count = 0, spoilt = 0;
    if (is_text && value) count = elliptic_numbers(text, value, 3 * (int64_t)ELLIPTIC_MODEL, &spoilt);
    for (; is_block && value && count < ELLIPTIC_BLOCK; ++count) value[count] = elliptic_float32(text + 4 * count);
    free(text);

    *components = count == 3 * (int64_t)ELLIPTIC_MODEL ? 3 : 1;
    *rows = is_block ? ELLIPTIC_SIDE : ELLIPTIC_J;
    *layers = is_block ? ELLIPTIC_SIDE : count == ELLIPTIC_LAYER ? 1 : ELLIPTIC_K;
    const int known = is_block || count == ELLIPTIC_LAYER || *components == 3;
    if (!is_text && !is_block)
        snprintf(message, ELLIPTIC_MESSAGE, "'%.100s' (%.0f bytes) is neither text of numbers nor %d float32 (%d bytes)", path, (double)size,
                 (int)ELLIPTIC_BLOCK, 4 * (int)ELLIPTIC_BLOCK);
    else if (!value) snprintf(message, ELLIPTIC_MESSAGE, "not enough memory for the numbers of '%.120s'", path);
    else if (count < 0) snprintf(message, ELLIPTIC_MESSAGE, "'%.120s': number %.0f cannot be read", path, (double)spoilt);
    else if (!known)
        snprintf(message, ELLIPTIC_MESSAGE, "'%.100s' has %.0f numbers; expected %d (the model: Kx, Ky, Kz) or %d (Kx of a layer): is it cut short?", path,
                 (double)count, 3 * (int)ELLIPTIC_MODEL, (int)ELLIPTIC_LAYER);
    for (int64_t k = 0; k < count && !message[0]; ++k)
        if (!(value[k] > 0.0 && value[k] <= DBL_MAX))
            snprintf(message, ELLIPTIC_MESSAGE, "'%.120s': number %.0f is %g, not a permeability", path, (double)(k + 1), value[k]);
    if (!message[0]) return value;
    free(value);
    return NULL;
}

/* Read the paper's part of the model: 60 x 60 cells of layer 85 (dim = 2) or 60 x 60 x 60 cells (dim = 3). Returns 0 or -1 with a message; the field is freed
 * with elliptic_field_free. A file with Kx alone gives k[1] = k[2] = k[0]: true for Ky in the whole model, and an assumption for Kz. */
static inline int elliptic_spe10_read(const char *path, int dim, elliptic_field *field, char message[ELLIPTIC_MESSAGE])
{
    int components, rows, layers;
    memset(field, 0, sizeof *field);
    double *value = elliptic_spe10_values(path, &components, &rows, &layers, message);
    if (!value) return -1;
    const int first = dim == 3 || layers == 1 ? 0 : ELLIPTIC_K - 1, depth = dim == 3 ? ELLIPTIC_SIDE : 1;
    if (first + depth > layers)
        snprintf(message, ELLIPTIC_MESSAGE, dim == 3 ? "'%.120s' has one layer; 60 are needed" : "'%.120s' does not reach down to layer 85", path);
    else if (!elliptic_field_open(field, ELLIPTIC_SIDE, ELLIPTIC_SIDE, depth, components)) snprintf(message, ELLIPTIC_MESSAGE, "not enough memory");
    if (!message[0]) {
        double *to = field->memory;
        for (int c = 0; c < components; ++c)
            for (int k = first; k < first + depth; ++k)
                for (int j = 0; j < ELLIPTIC_SIDE; ++j)
                    for (int i = 0; i < ELLIPTIC_SIDE; ++i)
                        *to++ = value[(size_t)i + ELLIPTIC_I * ((size_t)j + (size_t)rows * ((size_t)k + (size_t)layers * (size_t)c))];
        snprintf(field->source, sizeof field->source, "SPE10 model 2, %s, from '%.120s'%s",
                 dim == 3     ? "i, j, k = 1 to 60"
                 : layers > 1 ? "layer 85, i, j = 1 to 60"
                              : "a layer, i, j = 1 to 60",
                 path, components == 3 ? "" : " (Kx for all axes)");
    }
    free(value);
    return message[0] ? -1 : 0;
}

/* ---- made-up fields ---------------------------------------------------- */

typedef enum elliptic_surrogate {
    ELLIPTIC_LOGNORMAL, /* smooth, as the upper layers of SPE10 */
    ELLIPTIC_CHANNELS   /* two values, as its lower layers: channels along the second axis */
} elliptic_surrogate;

/* Two independent normal numbers (Box and Muller 1958), of which one is used. */
static inline double elliptic_normal(pcg32 *g)
{
    const double radius = sqrt(-2.0 * log(pcg32_uniform(g)));
    return radius * cos(2.0 * MATH_PI * pcg32_uniform(g));
}

/* Average along an axis with Gaussian weights of `reach` / 3 cells; what comes out is 2 `reach` cells shorter. Returns the new array (z is freed), or NULL. */
static inline double *elliptic_smooth(double *z, int n[3], int axis, int reach)
{
    const int stride = axis == 0 ? 1 : axis == 1 ? n[0] : n[0] * n[1], length = n[axis], shorter = length - 2 * reach;
    const int lines = n[0] * n[1] * n[2] / length;
    double *out = (double *)sparse_memory((int64_t)lines * shorter, sizeof *out);
    for (int line = 0; line < lines && out; ++line) {
        const int low = line % stride, high = line / stride;
        for (int m = 0; m < shorter; ++m) {
            double sum = 0.0;
            for (int r = -reach; r <= reach; ++r) sum += exp(-4.5 * r * r / ((double)reach * reach)) * z[low + stride * (m + reach + r + length * high)];
            out[low + stride * (m + shorter * high)] = sum;
        }
    }
    n[axis] = shorter;
    free(z);
    return out;
}

/* exp(sigma z): z is white noise averaged over Gaussians of 4 cells, whose correlation exp(-d^2/64) falls to 1/e at 8 cells, brought to mean 0 and variance 1;
 * sigma is 2.3, or as much more as a contrast of 1e4 takes. Returns 0 without memory or if all cells are equal. */
static inline int elliptic_lognormal(elliptic_field *field, pcg32 *g)
{
    const int reach = 12, cells = elliptic_cells(field->n);
    int n[3];
    for (int axis = 0; axis < 3; ++axis) n[axis] = field->n[axis] + (field->n[axis] > 1 ? 2 * reach : 0);
    const int all = elliptic_cells(n);
    double *z = all < 0 ? NULL : sparse_vector(all);
    for (int c = 0; c < all && z; ++c) z[c] = elliptic_normal(g);
    for (int axis = 2; axis >= 0 && z; --axis)
        if (field->n[axis] > 1) z = elliptic_smooth(z, n, axis, reach);
    if (!z) return 0;

    double mean = 0.0, square = 0.0, least = z[0], most = z[0];
    for (int c = 0; c < cells; ++c) {
        mean += z[c] / cells;
        least = fmin(least, z[c]);
        most = fmax(most, z[c]);
    }
    for (int c = 0; c < cells; ++c) square += (z[c] - mean) * (z[c] - mean) / cells;
    const double deviation = sqrt(square);
    if (most > least) {
        const double sigma = fmax(2.3 / deviation, 9.22 / (most - least)); /* e^9.22 > 1e4 */
        for (int c = 0; c < cells; ++c) field->k[0][c] = 100.0 * exp(sigma * (z[c] - mean));
    }
    free(z);
    return most > least;
}

/* 2000 mD in winding channels of 5 cells (and 4 layers) that reach from end to end, 0.001 mD elsewhere. Returns 0 if all cells are equal. */
static inline int elliptic_channels(elliptic_field *field, pcg32 *g)
{
    const int *n = field->n, cells = elliptic_cells(n), thick = n[2] > 1 ? 4 : 1, width = 5;
    const int channels = 1 + (int)(0.45 * n[0] * n[2] / (width * thick));
    int inside = 0;
    for (int c = 0; c < cells; ++c) field->k[0][c] = 1e-3;
    for (int m = 0; m < channels; ++m) {
        const double x = n[0] * pcg32_uniform(g), bend = 6.0 * pcg32_uniform(g), wave = 30.0 + 30.0 * pcg32_uniform(g),
                     phase = 2.0 * MATH_PI * pcg32_uniform(g);
        const int bottom = (int)((n[2] - thick + 1) * pcg32_uniform(g));
        for (int j = 0; j < n[1]; ++j) {
            const double left = x + bend * sin(2.0 * MATH_PI * j / wave + phase) - 0.5 * width;
            for (int k = bottom < 0 ? 0 : bottom; k < n[2] && k < bottom + thick; ++k)
                for (int i = 0; i < n[0]; ++i)
                    if (i + 0.5 >= left && i + 0.5 < left + width) field->k[0][i + n[0] * (j + n[1] * k)] = 2000.0;
        }
    }
    for (int c = 0; c < cells; ++c) inside += field->k[0][c] > 1.0;
    return inside > 0 && inside < cells;
}

/* An isotropic field in place of SPE10, the same for the same seed (but for rounding in the machine's exp, log, sin and cos). Returns 0 or -1 with a message.
 * n2 = 1: in two dimensions */
static inline int elliptic_surrogate_make(elliptic_surrogate kind, int n0, int n1, int n2, uint64_t seed, elliptic_field *field, char message[ELLIPTIC_MESSAGE])
{
    pcg32 g;
    pcg32_seed(&g, seed, 1 + (uint64_t)kind);
    message[0] = '\0';
    if (!elliptic_field_open(field, n0, n1, n2, 1)) {
        snprintf(message, ELLIPTIC_MESSAGE, "no memory for %d x %d x %d cells", n0, n1, n2);
        return -1;
    }
    if (!(kind == ELLIPTIC_CHANNELS ? elliptic_channels(field, &g) : elliptic_lognormal(field, &g))) {
        snprintf(message, ELLIPTIC_MESSAGE, "%d x %d x %d cells are too few, or there is no memory", n0, n1, n2);
        elliptic_field_free(field);
        return -1;
    }
    snprintf(field->source, sizeof field->source, "surrogate, not SPE10: %s, seed %.0f, contrast %.2g",
             kind == ELLIPTIC_CHANNELS ? "channels of two values" : "lognormal, correlation length 8 cells", (double)seed, elliptic_contrast(field));
    return 0;
}

#endif
