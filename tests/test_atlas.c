/* SPDX-License-Identifier: MIT
 *
 * What the atlas of operators measures with: eigenvalues, clouds and their volumes, fields with their answers, and
 * how it reads comments and sets formulas. In double only.
 */
#include "../sph_kernels.h"
#include "check.h"

#if SPH_SINGLE
int main(void) { return check_report("test_atlas"); }
#else

#include "../examples/atlas/sample.h"

#include "../examples/atlas/eigenvalues.h"
#include "../examples/atlas/families.h"
#include "../examples/atlas/figures.h"
#include "../examples/atlas/header.h"
#include "../examples/atlas/mathml.h"

#define SAYS(what, holds) CHECK_AT(what, 0L, holds)

/* The distance from a value to the nearest eigenvalue. */
static double nearest(int n, const complex_pair *value, double re, double im)
{
    double least = HUGE_VAL;
    for (int k = 0; k < n; k++) least = fmin(least, hypot(value[k].re - re, value[k].im - im));
    return least;
}
static void test_eigenvalues(void)
{
    enum { MOST = 24 };
    double a[MOST * MOST];
    complex_pair value[MOST];
    pcg32 g;
    /* second differences: -4 sin^2(pi k / (2 (n + 1))) */
    for (int q = 0; q < MOST * MOST; q++) a[q] = q / MOST == q % MOST ? -2.0 : abs(q / MOST - q % MOST) == 1 ? 1.0 : 0.0;
    SAYS("a symmetric matrix", eigenvalues(MOST, a, value));
    for (int k = 1; k <= MOST; k++) {
        const double s = sin(0.5 * acos(-1.0) * k / (MOST + 1));
        SAYS("its eigenvalues", nearest(MOST, value, -4.0 * s * s, 0.0) < 1e-12);
    }
    /* x^4 = 1, as a companion matrix: two are imaginary, and all have the same size */
    memset(a, 0, sizeof a);
    a[3] = a[4] = a[9] = a[14] = 1.0;
    SAYS("a matrix of a rotation", eigenvalues(4, a, value));
    SAYS("1", nearest(4, value, 1.0, 0.0) < 1e-12);
    SAYS("-1", nearest(4, value, -1.0, 0.0) < 1e-12);
    SAYS("i", nearest(4, value, 0.0, 1.0) < 1e-12);
    SAYS("-i", nearest(4, value, 0.0, -1.0) < 1e-12);
    /* of any matrix: sums of powers are traces */
    pcg32_seed(&g, 1, 1);
    double trace = 0.0, square = 0.0, re = 0.0, im = 0.0, squares = 0.0;
    for (int q = 0; q < MOST * MOST; q++) a[q] = pcg32_uniform(&g) - 0.5;
    for (int i = 0; i < MOST; i++) {
        trace += a[i * MOST + i];
        for (int j = 0; j < MOST; j++) square += a[i * MOST + j] * a[j * MOST + i];
    }
    SAYS("any matrix", eigenvalues(MOST, a, value));
    for (int k = 0; k < MOST; k++) {
        re += value[k].re;
        im += value[k].im;
        squares += value[k].re * value[k].re - value[k].im * value[k].im;
    }
    SAYS("its trace", fabs(re - trace) < 1e-12 && fabs(im) < 1e-12);
    SAYS("the trace of its square", fabs(squares - square) < 1e-11);
}

static void test_samples(int dim)
{
    for (int kind = 0; kind < SAMPLE_KINDS; kind++) {
        const sample_wish wish = {kind, 7, dim == 2 ? 0 : 11, 0.2, 3};
        sample s = sample_make(SPH_WENDLAND_C2, dim, 1.3, wish);
        double volume = 0.0, left = 0.0, off = 0.0;
        sph_index count[REGIONS] = {0};
        for (sph_index i = 0; i < s.n; i++) {
            volume += s.unit_volume[i];
            left += s.unit[0][i] == 0.0;
            for (int a = 0; a < dim; a++) off = fmax(off, fmax(-s.unit[a][i], s.unit[a][i] - (s.side - 0.5)));
        }
        for (sph_index i = 0; i < s.targets; i++)
            if (s.region[i] < REGIONS) count[s.region[i]]++;
        SAYS("volumes fill the domain", fabs(volume / pow(s.side - 0.5, dim) - 1.0) < 1e-2);
        SAYS("particles are in it", off <= 0.0);
        SAYS("some are on a wall", left > 0.0);
        if (dim == 2)
            for (int region = 0; region < REGIONS; region++) SAYS("every region has its targets", count[region] == 7);
        /* corrections that were scaled are those that are made anew */
        double once[SAMPLE_CORRECTIONS], worst = 0.0;
        sample_zoom(&s, 1.0);
        sample_zoom(&s, 0.125);
        for (int c = 0; c < SAMPLE_CORRECTIONS; c++) once[c] = s.correction[c][0];
        s.cloud = sph_cloud_range(s.cloud, 0, s.n);
        sample_corrections(&s);
        for (int c = 0; c < SAMPLE_CORRECTIONS; c++) worst = fmax(worst, fabs(once[c] - s.correction[c][0]) / (1.0 + fabs(once[c])));
        SAYS("corrections at another spacing", worst < 1e-9);
        sample_free(&s);
    }
}

/* Answers of families, from differences of the fields. */
static void test_answers(int dim)
{
    const double x[3] = {0.31, -0.23, dim > 2 ? 0.17 : 0.0}, e = 1e-4;
    for (int which = 0; which < WITH_ERRORS; which++) {
        wave_field f[3];
        field_jet j[3], near_by[3][6];
        double want[6], got[6] = {0.0}, laplacian[3] = {0.0}, d[3][3];
        family_waves(which, dim, f);
        for (int c = 0; c < 3; c++) {
            j[c] = field_at(&f[c], x);
            for (int a = 0; a < dim; a++) {
                for (int s = 0; s < 2; s++) {
                    double y[3] = {x[0], x[1], x[2]};
                    y[a] += s ? e : -e;
                    near_by[c][2 * a + s] = field_at(&f[c], y);
                }
                d[c][a] = (near_by[c][2 * a + 1].value - near_by[c][2 * a].value) / (2.0 * e);
                laplacian[c] += (near_by[c][2 * a + 1].value - 2.0 * j[c].value + near_by[c][2 * a].value) / (e * e);
                SAYS("first derivatives", fabs(d[c][a] - j[c].d[a]) < 1e-6);
            }
        }
        field_jet m;
        memset(&m, 0, sizeof m);
        m.value = 2.0;
        m.d[0] = 0.5;
        family_answer(which, dim, j, &m, want);
        switch (which) {
        case ADAPTIVE:
            SAYS("a density", j[0].value > 0.3 && j[0].value < 1.7);
            got[0] = j[0].value;
            break;
        case VALUE: got[0] = j[0].value; break;
        case PRESSURE:
            for (int a = 0; a < dim; a++) got[a] = -d[0][a];
            break;
        case GRADIENT:
            for (int a = 0; a < dim; a++) got[a] = d[0][a];
            break;
        case DIVERGENCE:
            for (int a = 0; a < dim; a++) got[0] += d[a][a];
            break;
        case CURL:
            got[dim == 2 ? 0 : 2] = d[1][0] - d[0][1];
            if (dim == 3) got[0] = d[2][1] - d[1][2], got[1] = d[0][2] - d[2][0];
            break;
        case LAPLACIAN: got[0] = laplacian[0]; break;
        case ELLIPTIC: got[0] = 2.0 * laplacian[0] + 0.5 * d[0][0]; break;
        case VISCOSITY:
            for (int a = 0; a < dim; a++) got[a] = laplacian[a];
            if (dim == 2) SAYS("a field without divergence", fabs(d[0][0] + d[1][1]) < 1e-6);
            else SAYS("a field without divergence", fabs(d[0][0] + d[1][1] + d[2][2]) < 1e-6);
            break;
        default: /* the Hessian: rows of differences of the gradient */
            got[0] = (near_by[0][1].d[0] - near_by[0][0].d[0]) / (2.0 * e);
            got[1] = (near_by[0][3].d[0] - near_by[0][2].d[0]) / (2.0 * e);
            got[2] = (near_by[0][3].d[1] - near_by[0][2].d[1]) / (2.0 * e);
            if (dim == 3) {
                got[3] = (near_by[0][5].d[0] - near_by[0][4].d[0]) / (2.0 * e);
                got[4] = (near_by[0][5].d[1] - near_by[0][4].d[1]) / (2.0 * e);
                got[5] = (near_by[0][5].d[2] - near_by[0][4].d[2]) / (2.0 * e);
            }
        }
        for (int c = 0; c < family_outputs(which, dim); c++) SAYS("the answer of a family", fabs(got[c] - want[c]) < 1e-5);
    }
    /* a monomial */
    const wave_field cubic = field_monomial(2, 1, 0);
    const field_jet j = field_at(&cubic, x);
    SAYS("x^2 y", fabs(j.value - x[0] * x[0] * x[1]) < 1e-15 && fabs(j.d[0] - 2.0 * x[0] * x[1]) < 1e-15 && fabs(j.hessian[0] - 2.0 * x[1]) < 1e-15 && fabs(j.hessian[1] - 2.0 * x[0]) < 1e-15);
}

static void test_comments(void)
{
    static char text[] = "\n/* A sum, exact\n   for linear u. It is exact for quadratic u inside of\n   lattices.\n   Atlas: gradient exact for linear fields, inside\n   lattices for quadratic fields; order 2 inside lattices, 1 in disorder, -1 at boundaries.\n"
                         " * Atlas: Hessian exact for joy; order 2. */\nSPH_FN sph_index sph_some(int a,\n    int b)\n{\n}\n";
    static char plain[sizeof text];
    header h;
    passage comment, signature;
    h.text = text;
    h.plain = plain;
    header_squeeze(text, plain);
    SAYS("words of several lines", header_says(&h, "inside lattices for quadratic fields; order"));
    SAYS("stars of comments", header_says(&h, "-1 at boundaries. Atlas: Hessian"));
    SAYS("a function", header_function(&h, "sph_some", &comment, &signature));
    SAYS("its signature", strncmp(signature.from, "SPH_FN sph_index sph_some(int a,\n    int b)", (size_t)(signature.to - signature.from)) == 0 && signature.to[-1] == ')');
    SAYS("its comment", strncmp(comment.from, "/* A sum,", 9) == 0 && comment.to[-1] == '/');
    SAYS("no function", !header_function(&h, "sph_none", &comment, &signature));
    const claim c = header_claim(&h, "sph_some", "gradient");
    SAYS("a claim", c.given == 1 && c.exact == 1 && c.exact_lattice == 2);
    SAYS("its orders", c.order[0] == 2 && c.order[1] == 1 && c.order[2] == -1);
    SAYS("a claim that is not understood", header_claim(&h, "sph_some", "Hessian").given == -1);
    char *const words = header_comment(&h, "sph_some");
    const char *at = words;
    int degree = -2, where = -2;
    SAYS("a phrase", header_phrase(&at, &degree, &where) && degree == 1 && where == 0);
    SAYS("a phrase on lattices", header_phrase(&at, &degree, &where) && degree == 2 && where == 1);
    SAYS("claims are no phrases", !header_phrase(&at, &degree, &where));
    free(words);
    SAYS("no claim", header_claim(&h, "sph_some", "curl").given == 0);
}

/* What is kept: pushes of pairs along their line keep both, one across it not the second, one alone nothing. */
static void test_sums(void)
{
    const sample_wish wish = {SAMPLE_JITTER, 0, 5, 0.2, 3};
    sample s = sample_make(SPH_WENDLAND_C2, 2, 1.3, wish);
    arrays a = arrays_of(s.n);
    portrait p;
    char text[160];
    sample_zoom(&s, 1.0);
    memset(&p, 0, sizeof p);
    p.energy = -1.0;
    for (int c = 0; c < 2; c++) {
        const double along = s.x[c][0] - s.x[c][7];
        a.out[c][0] = along / s.state[STATE_M][0];
        a.out[c][7] = -along / s.state[STATE_M][7];
    }
    sums_kept(&s, s.state[STATE_M], a.out, &p);
    kept_text(COLLISIONS, &p, text);
    SAYS("along the line", strcmp(text, "Atlas: keeps momentum and angular momentum; energy never grows.") == 0);
    a.out[0][0] += 1.0 / s.state[STATE_M][0];
    a.out[0][7] -= 1.0 / s.state[STATE_M][7];
    sums_kept(&s, s.state[STATE_M], a.out, &p);
    kept_text(RATES, &p, text);
    SAYS("across the line", strcmp(text, "Atlas: keeps momentum; energy never grows.") == 0);
    a.out[1][3] = 1.0;
    sums_kept(&s, s.state[STATE_M], a.out, &p);
    kept_text(GRAVITY, &p, text);
    SAYS("one alone", strcmp(text, "Atlas: keeps nothing.") == 0);
    kept_text(SHIFTING, &p, text);
    SAYS("no centre", strcmp(text, "Atlas: keeps nothing.") == 0);
    *figure_of(&p, "one", 1) = 2.0;
    *figure_of(&p, "two", 0) = 3.0;
    SAYS("figures", p.figure_count == 2 && *figure_of(&p, "one", 1) == 2.0 && isnan(*figure_of(&p, "one", 0)));
    arrays_free(&a);
    sample_free(&s);
}

static void set(const char *formula, const char *want)
{
    char got[1024] = "";
    FILE *const to = tmpfile();
    SAYS("a file", to != NULL);
    if (!to) return;
    mathml_write(to, formula);
    rewind(to);
    got[fread(got, 1, sizeof got - 1, to)] = '\0';
    fclose(to);
    if (strcmp(got, want) != 0) printf("%s\n", got);
    SAYS(formula, strcmp(got, want) == 0);
}
static void test_formulas(void)
{
    set("rho_i", "<math display=\"block\"><msub><mi>&#961;</mi><mrow><mi>i</mi></mrow></msub></math>");
    set("K^-1 e", "<math display=\"block\"><msup><mi>K</mi><mrow><mo>&#8722;</mo><mn>1</mn></mrow></msup><mspace width=\"0.25em\"/><mi>e</mi></math>");
    set("sum_j W_ij", "<math display=\"block\"><munder><mo>&#8721;</mo><mrow><mi>j</mi></mrow></munder><mspace width=\"0.25em\"/><msub><mi>W</mi><mrow><mi>i</mi><mi>j</mi></mrow></msub></math>");
    set("(a / (b))^(1/n)", "<math display=\"block\"><mo stretchy=\"false\">(</mo><mi>a</mi><mo>/</mo><mo stretchy=\"false\">(</mo><mi>b</mi><mo stretchy=\"false\">)</mo>"
                           "<msup><mo stretchy=\"false\">)</mo><mrow><mn>1</mn><mo>/</mo><mi>n</mi></mrow></msup></math>");
    set("P* dpsi", "<math display=\"block\"><msup><mi>P</mi><mo>*</mo></msup><mspace width=\"0.25em\"/><mrow><mi>d</mi><mi>&#968;</mi></mrow></math>");
    set("(a)^4 b", "<math display=\"block\"><mo stretchy=\"false\">(</mo><mi>a</mi><msup><mo stretchy=\"false\">)</mo><mrow><mn>4</mn></mrow></msup><mi>b</mi></math>");
    set("a < 2 . b", "<math display=\"block\"><mi>a</mi><mo>&lt;</mo><mn>2</mn><mo>&#8901;</mo><mi>b</mi></math>");
}

int main(void)
{
    test_eigenvalues();
    test_samples(2);
    test_samples(3);
    test_answers(2);
    test_answers(3);
    test_comments();
    test_sums();
    test_formulas();
    return check_report("test_atlas");
}
#endif
