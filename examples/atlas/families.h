/* SPDX-License-Identifier: MIT
 *
 * families.h - what the operators of a family take and give, and the fields that they are tried on.
 *
 * Fields are sums of three waves, or monomials. Those of vectors have no divergence where the operators of
 * the family are made for such fields (viscosities).
 *
 * The last families are of operators that are not linear in a field: figures.h says what is measured of them.
 */
#ifndef ATLAS_FAMILIES_H
#define ATLAS_FAMILIES_H

#include <math.h>
#include <string.h>

/*      name, heading, word of the claims, vector in, vector out (0: one number; 1: dim; 2: curl; 3: Hessian), powers of 1 / length */
#define ATLAS_FAMILIES(X) \
    X(VALUE, "Interpolation and density", "value", 0, 0, 0) \
    X(GRADIENT, "Gradients", "gradient", 0, 1, 1) \
    X(PRESSURE, "Gradients that conserve: forces of pressure", "gradient", 0, 1, 1) \
    X(DIVERGENCE, "Divergences", "divergence", 1, 0, 1) \
    X(CURL, "Curls", "curl", 1, 2, 1) \
    X(LAPLACIAN, "Laplacians", "Laplacian", 0, 0, 2) \
    X(HESSIAN, "Second derivatives", "Hessian", 0, 3, 2) \
    X(ELLIPTIC, "div(m grad u)", "div(m grad u)", 0, 0, 2) \
    X(VISCOSITY, "Physical viscosity and resistivity", "Laplacian", 1, 1, 2) \
    X(ADAPTIVE, "Density with a smoothing length of its own", "value", 0, 0, 0) \
    X(RATES, "Rates of a fluid, with dissipation", "", 1, 1, 0) \
    X(SHIFTING, "Shifting", "", 0, 1, 0) \
    X(COLLISIONS, "Collisions", "", 1, 1, 0) \
    X(GRAVITY, "Gravity", "", 0, 1, 0)

/* LINEAR: families below it have a matrix and a response; WITH_ERRORS: those below it have errors against a field. */
#define FAMILY_ENUM(name, heading, word, in, out, powers) name,
enum family { ATLAS_FAMILIES(FAMILY_ENUM) FAMILIES, LINEAR = ADAPTIVE, WITH_ERRORS = RATES };
typedef struct family_of {
    const char *heading, *word;
    int in, out, powers;
} family_of;
static inline family_of family(int which)
{
#define FAMILY_ROW(name, heading, word, in, out, powers) {heading, word, in, out, powers},
    static const family_of all[FAMILIES] = {ATLAS_FAMILIES(FAMILY_ROW)};
    return all[which];
}
static inline int family_inputs(int which, int dim) { return family(which).in ? dim : 1; }
static inline int family_outputs(int which, int dim)
{
    switch (family(which).out) {
    case 1: return dim;
    case 2: return dim == 2 ? 1 : 3;
    case 3: return dim * (dim + 1) / 2;
    default: return 1;
    }
}

/* A field with its first and second derivatives: d[0 ... 2] of x, y, z, and hessian xx, xy, yy, xz, yz, zz. */
typedef struct field_jet {
    double value, d[3], hessian[6];
} field_jet;
typedef struct wave_field {
    int monomial[3], waves; /* a product of powers, if waves is 0 */
    double size[3], k[3][3], phase[3];
} wave_field;

static inline field_jet field_at(const wave_field *f, const double *x)
{
    static const int first[6] = {0, 0, 1, 0, 1, 2}, second[6] = {0, 1, 1, 2, 2, 2};
    field_jet j;
    memset(&j, 0, sizeof j);
    for (int w = 0; w < f->waves; w++) {
        const double *const k = f->k[w], t = k[0] * x[0] + k[1] * x[1] + k[2] * x[2] + f->phase[w], s = f->size[w] * sin(t), c = f->size[w] * cos(t);
        j.value += s;
        for (int a = 0; a < 3; a++) j.d[a] += k[a] * c;
        for (int a = 0; a < 6; a++) j.hessian[a] -= k[first[a]] * k[second[a]] * s;
    }
    if (!f->waves) {
        double power[3][3]; /* of each axis: x^p, its first and its second derivative */
        for (int a = 0; a < 3; a++) {
            const int p = f->monomial[a];
            power[a][0] = pow(x[a], p);
            power[a][1] = p > 0 ? p * pow(x[a], p - 1) : 0.0;
            power[a][2] = p > 1 ? p * (p - 1) * pow(x[a], p - 2) : 0.0;
        }
        j.value = power[0][0] * power[1][0] * power[2][0];
        for (int a = 0; a < 3; a++) j.d[a] = power[0][a == 0] * power[1][a == 1] * power[2][a == 2];
        for (int a = 0; a < 6; a++) {
            int n[3] = {0, 0, 0};
            n[first[a]]++;
            n[second[a]]++;
            j.hessian[a] = power[0][n[0]] * power[1][n[1]] * power[2][n[2]];
        }
    }
    return j;
}

/* Three waves; different numbers give different fields. Nothing in them vanishes at the origin. */
static inline wave_field field_waves(int dim, int number)
{
    static const double k[3][3] = {{2.3, 1.7, -1.3}, {-1.1, 2.1, 0.9}, {0.7, -1.3, 2.2}}, phase[3] = {0.6, 1.1, 2.3};
    wave_field f;
    memset(&f, 0, sizeof f);
    f.waves = 3;
    for (int w = 0; w < 3; w++) {
        f.size[w] = 1.0 / (1.0 + w);
        f.phase[w] = phase[w] + 0.7 * number;
        for (int a = 0; a < dim; a++) f.k[w][a] = k[w][a];
    }
    return f;
}
static inline wave_field field_monomial(int x, int y, int z)
{
    wave_field f;
    memset(&f, 0, sizeof f);
    f.monomial[0] = x;
    f.monomial[1] = y;
    f.monomial[2] = z;
    return f;
}

/* What a family is tried on: one field, or one for each component. A vector without divergence has waves whose
   amplitudes are perpendicular to k. */
static inline void family_waves(int which, int dim, wave_field *f)
{
    for (int a = 0; a < 3; a++) f[a] = field_waves(dim, which == VISCOSITY ? 0 : a);
    if (which == VISCOSITY)
        for (int w = 0; w < 3; w++) {
            const double *const k = f[0].k[w], size = f[0].size[w] / 2.5;
            const double across[3] = {-k[1] * size, (k[0] - (dim > 2 ? k[2] : 0.0)) * size, k[1] * size}; /* k . across = 0 */
            for (int a = 0; a < 3; a++) f[a].size[w] = a < dim ? across[a] : 0.0;
        }
    if (which == ADAPTIVE) { /* a positive density: the third wave is 1 */
        for (int w = 0; w < 2; w++) f[0].size[w] *= 0.4;
        for (int a = 0; a < 3; a++) f[0].k[2][a] = 0.0;
        f[0].size[2] = 1.0;
        f[0].phase[2] = 0.5 * acos(-1.0);
    }
}

/* The result that a family should give, from the jets of its inputs and that of the mobility. */
static inline void family_answer(int which, int dim, const field_jet *f, const field_jet *m, double *out)
{
    static const int square[3] = {0, 2, 5};
    double laplacian[3] = {0.0, 0.0, 0.0};
    for (int c = 0; c < (family(which).in ? dim : 1); c++)
        for (int a = 0; a < dim; a++) laplacian[c] += f[c].hessian[square[a]];
    switch (which) {
    case VALUE:
    case ADAPTIVE: out[0] = f[0].value; break;
    case GRADIENT:
        for (int a = 0; a < dim; a++) out[a] = f[0].d[a];
        break;
    case PRESSURE:
        for (int a = 0; a < dim; a++) out[a] = -f[0].d[a];
        break;
    case DIVERGENCE:
        out[0] = 0.0;
        for (int a = 0; a < dim; a++) out[0] += f[a].d[a];
        break;
    case CURL:
        if (dim == 2) out[0] = f[1].d[0] - f[0].d[1];
        else
            for (int a = 0; a < 3; a++) out[a] = f[(a + 2) % 3].d[(a + 1) % 3] - f[(a + 1) % 3].d[(a + 2) % 3];
        break;
    case LAPLACIAN: out[0] = laplacian[0]; break;
    case HESSIAN:
        for (int a = 0; a < dim * (dim + 1) / 2; a++) out[a] = f[0].hessian[a];
        break;
    case ELLIPTIC:
        out[0] = m->value * laplacian[0];
        for (int a = 0; a < dim; a++) out[0] += m->d[a] * f[0].d[a];
        break;
    default:
        for (int a = 0; a < dim; a++) out[a] = laplacian[a];
    }
}

/* The size of the answers, to which errors are related: of waves of the size 1 and |k| about 2.5. */
static inline double family_scale(int which) { return pow(2.5, family(which).powers); }

#endif
