/* SPDX-License-Identifier: MIT */
/*
 * test_elliptic_reference [DIR] - examples/papers/elliptic_reference.h: the finite-volume and mimetic columns of the elliptic paper's tables 2 and 6, exact
 * cases, the reader of permeability files and the made-up fields. Writes and removes one file in DIR (default: $BUILD, or the current directory).
 */
#include "check.h"

#include "../examples/papers/elliptic_reference.h"

static double *new_doubles(int64_t count)
{
    double *memory = (double *)sparse_memory(count, sizeof *memory);
    if (!memory) {
        fprintf(stderr, "test_elliptic_reference: no memory\n");
        exit(2);
    }
    for (int64_t k = 0; k < count; ++k) memory[k] = 0.0;
    return memory;
}

/* x = A^-1 b from x = 0; A is freed. */
static void solve(sparse *A, const double *b, double *x)
{
    sparse_preconditioner P;
    sparse_options o = sparse_defaults();
    o.tolerance = 1e-12;
    o.max_iterations = 5000;
    CHECK(sparse_preconditioner_make(&P, SPARSE_ILU0, A) == 0);
    CHECK(sparse_bicgstab(A, &P, b, x, &o).converged);
    sparse_preconditioner_free(&P);
    sparse_free(A);
}

static double *tpfa(const elliptic_box *box)
{
    const int cells = elliptic_cells(box->n);
    double *b = new_doubles(cells), *u = new_doubles(cells);
    sparse A;
    CHECK(elliptic_tpfa(box, &A, b) == 0);
    solve(&A, b, u);
    free(b);
    return u;
}

static double *mimetic(const elliptic_box *box)
{
    const int n = box->n[0], faces = elliptic_mimetic_faces(n);
    double *b = new_doubles(faces), *x = new_doubles(faces), *u = new_doubles((int64_t)n * n);
    sparse A;
    CHECK(elliptic_mimetic(box, &A, b) == 0);
    solve(&A, b, x);
    elliptic_mimetic_cells(n, x, u);
    free(b);
    free(x);
    return u;
}

/* ---- the paper's tables ------------------------------------------------ */

/* Is the measured value the published one, which has four digits? A little more than half a unit of the last, because the paper may have rounded twice. */
static void check_digits(double measured, double published)
{
    const double unit = pow(10.0, floor(log10(published)) - 3.0);
    CHECK_CLOSE(measured, published, 0.55 * unit);
}

static void test_tables(void)
{
    static const double published[2][2][5] = {
        {{1.318e-1, 3.296e-2, 8.233e-3, 2.058e-3, 5.318e-4}, {1.240e-1, 3.078e-2, 7.685e-3, 1.920e-3, 4.968e-4}},  /* table 2: MPFA = TPFA, mimetic */
        {{1.489e-1, 2.015e-2, 2.727e-3, 3.666e-4, 4.951e-5}, {2.651e-2, 4.424e-3, 6.889e-4, 1.024e-4, 1.522e-5}}}; /* table 6 */
    for (int mixed = 0; mixed < 2; ++mixed)
        for (int level = 0, n = 5; level < 5; ++level, n *= 2) {
            const elliptic_box box = elliptic_square_of(n, mixed);
            double *exact = new_doubles((int64_t)n * n);
            elliptic_square_exact(n, mixed, 100, exact);
            for (int scheme = 0; scheme < 2; ++scheme) {
                double *u = scheme ? mimetic(&box) : tpfa(&box);
                check_digits(elliptic_printed_error(elliptic_relative_error((int64_t)n * n, exact, u), n), published[mixed][scheme][level]);
                free(u);
            }
            free(exact);
        }
}

/* ---- series ------------------------------------------------------------ */

static void test_series(void)
{
    /* By symmetry the centre of a square has the mean of its sides. */
    static const double psi[4] = {100.0, 90.0, 150.0, 200.0}, one[4] = {1.0, 1.0, 1.0, 1.0};
    CHECK_CLOSE(elliptic_series_dirichlet(0.5, 0.5, 1.0, 1.0, psi, 100), 135.0, 1e-11);
    CHECK_CLOSE(elliptic_series_dirichlet(0.3, 0.6, 1.7, 0.8, one, 100), 1.0, 1e-11);

    /* A rectangle, so that its sides are told apart: boundary values (the series converge as 1/n there), Laplace's equation by differences. */
    const double L = 1.7, H = 0.8, d = 1e-3;
    CHECK_CLOSE(elliptic_series_dirichlet(0.85, 0.0, L, H, psi, 100000), psi[0], 2e-3);
    CHECK_CLOSE(elliptic_series_dirichlet(L, 0.4, L, H, psi, 100000), psi[1], 2e-3);
    CHECK_CLOSE(elliptic_series_dirichlet(0.85, H, L, H, psi, 100000), psi[2], 2e-3);
    CHECK_CLOSE(elliptic_series_dirichlet(0.0, 0.4, L, H, psi, 100000), psi[3], 2e-3);
    for (int mixed = 0; mixed < 2; ++mixed) {
        double u[5];
        for (int k = 0; k < 5; ++k) {
            const double x = 0.5 + (k == 1 ? d : k == 2 ? -d : 0.0), y = 0.3 + (k == 3 ? d : k == 4 ? -d : 0.0);
            u[k] = mixed ? elliptic_series_mixed(x, y, L, H, psi, 100) : elliptic_series_dirichlet(x, y, L, H, psi, 100);
        }
        CHECK_CLOSE((u[1] + u[2] + u[3] + u[4] - 4.0 * u[0]) / (d * d), 0.0, 1e-2);
        CHECK(fabs(u[1] + u[2] - 2.0 * u[0]) / (d * d) > 1.0); /* each part of it is there */
    }

    /* The mixed one: u = psi[0] at y = 0, outward derivatives at the others, by one-sided differences of second order. */
    const double e = 1e-4;
    CHECK_CLOSE(elliptic_series_mixed(0.6, 0.0, L, H, psi, 1000), psi[0], 1e-11);
    for (int side = 1; side < 4; ++side) {
        double u[3];
        for (int k = 0; k < 3; ++k) {
            const double x = side == 1 ? L - k * e : side == 3 ? k * e : 0.6, y = side == 2 ? H - k * e : 0.4;
            u[k] = elliptic_series_mixed(x, y, L, H, psi, 100000);
        }
        CHECK_CLOSE((3.0 * u[0] - 4.0 * u[1] + u[2]) / (2.0 * e), psi[side], 0.05);
    }

    const double exact[2] = {2.0, 4.0}, near[2] = {2.2, 3.0};
    CHECK_CLOSE(elliptic_relative_error(2, exact, near), sqrt((0.01 + 0.0625) / 2.0), 1e-15);
    CHECK_CLOSE(elliptic_printed_error(0.02, 40), 0.05, 1e-15);
}

/* ---- two-point fluxes and mimetic scheme ------------------------------- */

/* Layers across the flow: the pressure drops as in resistors, one half cell after the other, which the harmonic mean makes exact. Along every axis in turn. */
static void test_resistors(void)
{
    for (int axis = 0; axis < 3; ++axis) {
        elliptic_box box;
        memset(&box, 0, sizeof box);
        for (int a = 0; a < 3; ++a) {
            box.n[a] = 3 + a;
            box.size[a] = 0.5 + a;
        }
        const int cells = elliptic_cells(box.n), n = box.n[axis], stride = axis == 0 ? 1 : axis == 1 ? 3 : 12;
        double *k = new_doubles(cells), *other = new_doubles(cells), resistance = 0.0, at = 0.0;
        for (int c = 0; c < cells; ++c) {
            k[c] = pow(10.0, c / stride % n); /* contrasts of 10 from layer to layer */
            other[c] = 1.0 + c % 7;           /* across the flow it must not matter */
        }
        for (int a = 0; a < 3; ++a) box.k[a] = a == axis ? k : other;
        box.side[axis][0].dirichlet = box.side[axis][1].dirichlet = 1;
        box.side[axis][0].value = 3.0;
        box.side[axis][1].value = 5.0;
        for (int m = 0; m < n; ++m) resistance += box.size[axis] / pow(10.0, m);
        double *u = tpfa(&box);
        for (int m = 0; m < n; ++m) {
            at += 0.5 * box.size[axis] / pow(10.0, m);
            for (int c = 0; c < cells; ++c)
                if (c / stride % n == m) CHECK_CLOSE(u[c], 3.0 + 2.0 * at / resistance, 1e-7);
            at += 0.5 * box.size[axis] / pow(10.0, m);
        }
        free(u);

        /* the same flow, prescribed as a flux through the high end */
        box.side[axis][1].dirichlet = 0;
        box.side[axis][1].value = 2.0 / resistance;
        u = tpfa(&box);
        CHECK_CLOSE(u[cells - 1], 5.0 - 2.0 * (0.5 * box.size[axis] / pow(10.0, n - 1)) / resistance, 1e-7);
        free(u);
        free(k);
        free(other);
    }
}

/* A box of different cells: rows add up to what leaves through Dirichlet faces, and A = A^T. */
static void test_tpfa_matrix(void)
{
    elliptic_field field;
    char message[ELLIPTIC_MESSAGE];
    CHECK(elliptic_surrogate_make(ELLIPTIC_LOGNORMAL, 7, 6, 5, 3, &field, message) == 0);
    elliptic_box box;
    memset(&box, 0, sizeof box);
    for (int a = 0; a < 3; ++a) {
        box.n[a] = field.n[a];
        box.size[a] = 1.0 + 0.5 * a;
        box.k[a] = field.k[a];
    }
    box.side[1][0].dirichlet = box.side[1][1].dirichlet = 1;
    box.side[1][1].value = 1.0;
    const int cells = elliptic_cells(box.n);
    double *b = new_doubles(cells), *one = new_doubles(cells), *sum = new_doubles(cells);
    sparse A, T;
    CHECK(elliptic_tpfa(&box, &A, b) == 0 && sparse_transpose(&A, &T) == 0);
    CHECK(A.start[cells] == 7 * cells - 2 * (7 * 6 + 6 * 5 + 5 * 7));
    for (int64_t k = 0; k < A.start[cells]; ++k) CHECK(A.index[k] == T.index[k] && fabs(A.value[k] - T.value[k]) <= 1e-14 * fabs(A.value[k]));
    for (int c = 0; c < cells; ++c) one[c] = 1.0;
    sparse_multiply(&A, one, sum);
    for (int c = 0; c < cells; ++c) {
        const int j = c / 7 % 6;
        const double T_side = j == 0 || j == 5 ? 2.0 * field.k[1][c] * box.size[0] * box.size[2] / box.size[1] : 0.0, row = A.value[sparse_diagonal(&A, c)];
        CHECK_CLOSE(sum[c], T_side, 1e-13 * row);
        CHECK_CLOSE(b[c], j == 5 ? T_side : 0.0, 1e-13 * row);
    }
    sparse_free(&T);
    sparse_free(&A);

    field.k[0][11] = 0.0;
    CHECK(elliptic_tpfa(&box, &A, b) == -2 && A.n == 0);
    field.k[0][11] = (double)NAN;
    CHECK(elliptic_tpfa(&box, &A, b) == -2);
    field.k[0][11] = 1.0;
    box.size[2] = 0.0;
    CHECK(elliptic_tpfa(&box, &A, b) == -2);
    box.size[2] = 1.0;
    box.n[2] = 0;
    CHECK(elliptic_tpfa(&box, &A, b) == -2);
    box.n[2] = 5;
    CHECK(elliptic_tpfa(&box, &A, b) == 0);
    CHECK(elliptic_mimetic(&box, &T, b) == -2);
    sparse_free(&A);
    free(b);
    free(one);
    free(sum);
    elliptic_field_free(&field);
}

/* The mimetic scheme is exact for linear functions, here y and -3 x, with values on one pair of sides and fluxes on another. */
static void test_mimetic_linear(void)
{
    const elliptic_side closed = {0, 0.0}, zero = {1, 0.0}, one = {1, 1.0}, in = {0, 3.0}, start = {1, 0.5};
    for (int n = 1; n <= 7; n += 3) {
        const elliptic_box up = elliptic_square(n, zero, closed, one, closed), left = elliptic_square(n, closed, start, closed, in);
        double *u = mimetic(&up), *v = mimetic(&left);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                CHECK_CLOSE(u[j * n + i], (j + 0.5) / n, 1e-10);
                CHECK_CLOSE(v[j * n + i], 0.5 + 3.0 * (1.0 - (i + 0.5) / n), 1e-10);
            }
        free(u);
        free(v);
    }
}

/* ---- permeability files ------------------------------------------------ */

static char path[1024];

static void write_file(const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) {
        fprintf(stderr, "test_elliptic_reference: cannot write '%s'\n", path);
        exit(2);
    }
}

/* What the files of this test hold at (i, j, k) of a component: two digits, and different for neighbours in all four. */
static int planted(int i, int j, int k, int component) { return 10 + (i + 7 * j + 31 * k + 43 * component) % 89; }

static char *text_of(int count, int layers, size_t *size)
{
    char *text = (char *)sparse_memory(3 * (int64_t)count, 1);
    if (!text) exit(2);
    for (int m = 0; m < count; ++m) {
        const int i = m % 60, j = m / 60 % 220, k = m / 13200 % layers, value = planted(i, j, k, m / 13200 / layers);
        text[3 * m] = (char)('0' + value / 10);
        text[3 * m + 1] = (char)('0' + value % 10);
        text[3 * m + 2] = m % 6 == 5 ? '\n' : ' ';
    }
    *size = 3 * (size_t)count;
    return text;
}

/* The file must be refused, with a message that says `why`. */
static void check_refused(int dim, const char *why)
{
    elliptic_field field;
    char message[ELLIPTIC_MESSAGE];
    CHECK(elliptic_spe10_read(path, dim, &field, message) == -1);
    if (!check_count(strstr(message, why) != NULL && !field.memory)) fprintf(stderr, "expected '%s' in: %s\n", why, message);
}

static void check_planted(int dim, int components, int layer)
{
    elliptic_field field;
    char message[ELLIPTIC_MESSAGE];
    CHECK(elliptic_spe10_read(path, dim, &field, message) == 0 && message[0] == '\0');
    if (!field.memory) return;
    CHECK(field.n[0] == 60 && field.n[1] == 60 && field.n[2] == (dim == 3 ? 60 : 1));
    CHECK(strstr(field.source, "SPE10") != NULL && strstr(field.source, path) != NULL);
    int wrong = 0;
    for (int component = 0; component < 3; ++component)
        for (int k = 0; k < field.n[2]; ++k)
            for (int j = 0; j < 60; ++j)
                for (int i = 0; i < 60; ++i) wrong += field.k[component][i + 60 * (j + 60 * k)] != planted(i, j, k + layer, components == 3 ? component : 0);
    CHECK(wrong == 0);
    CHECK((field.k[2] == field.k[0]) == (components == 1));
    elliptic_field_free(&field);
}

static void test_text_files(void)
{
    size_t size;
    char *text = text_of(ELLIPTIC_LAYER, 1, &size);
    write_file(text, size);
    check_planted(2, 1, 0);
    check_refused(3, "has one layer");
    write_file(text, size - 3);
    check_refused(2, "has 13199 numbers");
    write_file(text, size - 2); /* the last number is cut, and still a number: the reader cannot know */
    text[3 * 100] = '-';
    write_file(text, size);
    check_refused(2, "number 101 is -");
    text[3 * 100] = '.';
    text[3 * 100 + 1] = '.';
    write_file(text, size);
    check_refused(2, "number 101 cannot be read");
    text[3 * 100] = '7';
    text[3 * 100 + 1] = '-';
    write_file(text, size);
    check_refused(2, "number 101 cannot be read");
    text[3 * 100] = '0';
    text[3 * 100 + 1] = '0';
    write_file(text, size);
    check_refused(2, "number 101 is 0");
    text[3 * 100] = 'x';
    write_file(text, size);
    check_refused(2, "neither text of numbers");
    write_file(text, 30);
    check_refused(2, "has 10 numbers");
    write_file("", 0);
    check_refused(2, "has 0 numbers");
    write_file("1e999 1", 7);
    check_refused(2, "has 2 numbers");
    free(text);

    text = text_of(3 * ELLIPTIC_MODEL, ELLIPTIC_K, &size); /* the whole model */
    write_file(text, size);
    check_planted(2, 3, 84);
    check_planted(3, 3, 0);
    write_file(text, size - 3);
    check_refused(3, "has 3365999 numbers");
    text[size - 1] = '1';
    text = (char *)realloc(text, size + 3);
    if (!text) exit(2);
    memcpy(text + size, " 1\n", 3); /* one too many */
    write_file(text, size + 3);
    check_refused(2, "has 3366001 numbers");
    free(text);

    remove(path);
    check_refused(2, "cannot open");
}

/* Bytes of a float32 that is planted(...) = 10 to 98: sign 0, exponent, 23 bits of fraction. */
static void put_float32(char *bytes, int value)
{
    int exponent = 0;
    while (value >> (exponent + 1)) ++exponent;
    const uint32_t bits = (uint32_t)(127 + exponent) << 23 | ((uint32_t)value << (23 - exponent) & 0x7fffffU);
    for (int k = 0; k < 4; ++k) bytes[k] = (char)(bits >> (8 * k) & 0xff);
}

static void test_float_file(void)
{
    const size_t size = 4 * (size_t)ELLIPTIC_BLOCK;
    char *bytes = (char *)sparse_memory((int64_t)size, 1);
    if (!bytes) exit(2);
    for (int m = 0; m < ELLIPTIC_BLOCK; ++m) put_float32(bytes + 4 * m, planted(m % 60, m / 60 % 60, m / 3600, 0));
    write_file(bytes, size);
    check_planted(3, 1, 0);
    check_refused(2, "layer 85");
    write_file(bytes, size - 4);
    check_refused(3, "neither text");
    static const char bad[4][4] = {{0, 0, (char)0x80, 0x7f}, {0, 0, (char)0xc0, 0x7f}, {0, 0, 0, 0}, {0, 0, (char)0x80, (char)0xbf}}; /* infinity, NaN, 0, -1 */
    for (int k = 0; k < 4; ++k) {
        memcpy(bytes + 4 * 777, bad[k], 4);
        write_file(bytes, size);
        check_refused(3, "number 778 is");
    }
    free(bytes);
    remove(path);

    static const char fractions[3][4] = {{(char)0xdb, 0x0f, 0x49, 0x40}, {0, 0, 0x40, (char)0xc0}, {1, 0, 0, 0}}; /* float(pi), -3, the smallest */
    CHECK_CLOSE(elliptic_float32(fractions[0]), 3.14159274101257324, 1e-17);
    CHECK(elliptic_float32(fractions[1]) == -3.0 && elliptic_float32(fractions[2]) == ldexp(1.0, -149));
}

/* ---- made-up fields ---------------------------------------------------- */

static elliptic_field surrogate(elliptic_surrogate kind, int n2, uint64_t seed)
{
    elliptic_field field;
    char message[ELLIPTIC_MESSAGE];
    CHECK(elliptic_surrogate_make(kind, 60, 60, n2, seed, &field, message) == 0);
    if (!field.memory) exit(1);
    CHECK(strstr(field.source, "surrogate, not SPE10") != NULL);
    return field;
}

static void test_surrogates(void)
{
    for (int kind = ELLIPTIC_LOGNORMAL; kind <= ELLIPTIC_CHANNELS; ++kind)
        for (int n2 = 1; n2 <= 11; n2 += 10) {
            elliptic_field a = surrogate((elliptic_surrogate)kind, n2, 5), b = surrogate((elliptic_surrogate)kind, n2, 5),
                           c = surrogate((elliptic_surrogate)kind, n2, 6);
            const size_t size = 3600 * (size_t)n2 * sizeof(double);
            CHECK(memcmp(a.k[0], b.k[0], size) == 0);
            CHECK(memcmp(a.k[0], c.k[0], size) != 0);
            CHECK(a.k[1] == a.k[0] && a.k[2] == a.k[0] && a.n[2] == n2);
            elliptic_field_free(&a);
            elliptic_field_free(&b);
            elliptic_field_free(&c);
        }

    /* Contrasts, the share of channels, that they reach from end to end, and how far the lognormal field is correlated. */
    enum { SEEDS = 40 };
    double correlation[2] = {0.0, 0.0}, share = 0.0;
    for (int seed = 1; seed <= SEEDS; ++seed) {
        elliptic_field f = surrogate(ELLIPTIC_LOGNORMAL, 1, (uint64_t)seed);
        CHECK(elliptic_contrast(&f) >= 1e4 && elliptic_contrast(&f) <= 1e8);
        for (int far = 0; far < 2; ++far) {
            const int lag = far ? 20 : 8;
            double product = 0.0, square = 0.0;
            for (int j = 0; j < 60; ++j)
                for (int i = 0; i < 60; ++i) {
                    const double z = log(f.k[0][i + 60 * j] / 100.0);
                    square += z * z / 3600.0;
                    if (i + lag < 60) product += z * log(f.k[0][i + lag + 60 * j] / 100.0) / (60.0 * (60 - lag));
                }
            correlation[far] += product / square / SEEDS;
        }
        elliptic_field_free(&f);

        f = surrogate(ELLIPTIC_CHANNELS, 1, (uint64_t)seed);
        CHECK_RELATIVE(elliptic_contrast(&f), 2e6, 1e-12);
        char wet[3600];
        for (int m = 0; m < 3600; ++m) {
            wet[m] = m < 60 && f.k[0][m] > 1.0;
            share += (f.k[0][m] > 1.0) / 3600.0 / SEEDS;
        }
        for (int sweep = 0; sweep < 60; ++sweep)
            for (int m = 0; m < 3600; ++m)
                if (f.k[0][m] > 1.0 && ((m >= 60 && wet[m - 60]) || (m % 60 > 0 && wet[m - 1]) || (m % 60 < 59 && wet[m + 1]))) wet[m] = 1;
        int arrived = 0;
        for (int i = 0; i < 60; ++i) arrived += wet[3540 + i];
        CHECK(arrived > 0);
        elliptic_field_free(&f);
    }
    CHECK(correlation[0] > 0.2 && correlation[0] < 0.45); /* 1/e, but for the sample's own mean and deviation */
    CHECK(fabs(correlation[1]) < 0.12);
    CHECK(share > 0.25 && share < 0.5);

    /* Values of one seed, so that no change goes unseen. */
    elliptic_field f = surrogate(ELLIPTIC_LOGNORMAL, 1, 1);
    CHECK_RELATIVE(f.k[0][0], 342.24641414687926, 1e-9);
    CHECK_RELATIVE(f.k[0][3599], 59.165892032568436, 1e-9);
    elliptic_field_free(&f);

    elliptic_field field;
    char message[ELLIPTIC_MESSAGE];
    CHECK(elliptic_surrogate_make(ELLIPTIC_LOGNORMAL, 1, 1, 1, 1, &field, message) == -1 && !field.memory && strstr(message, "too few"));
    CHECK(elliptic_surrogate_make(ELLIPTIC_CHANNELS, 1, 1, 1, 1, &field, message) == -1 && !field.memory && strstr(message, "too few"));
    CHECK(elliptic_surrogate_make(ELLIPTIC_CHANNELS, 0, 9, 1, 1, &field, message) == -1 && !field.memory && message[0]);
}

int main(int argc, char **argv)
{
    const char *dir = argc > 1 ? argv[1] : getenv("BUILD");
    snprintf(path, sizeof path, "%.900s/test_elliptic_reference.tmp", dir ? dir : ".");
    test_tables();
    test_series();
    test_resistors();
    test_tpfa_matrix();
    test_mimetic_linear();
    test_text_files();
    test_float_file();
    test_surrogates();
    return check_report("test_elliptic_reference");
}
