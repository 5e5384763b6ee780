/* SPDX-License-Identifier: MIT
 *
 * cleaning_euler_potentials.c - section II-A1 of the paper on divergence cleaning, in three dimensions: 'magnetic field windings in particular cannot be modelled past one rotation' with Euler potentials.
 *
 *     cc -O2 -o cleaning_euler_potentials examples/papers/cleaning_euler_potentials.c -lm
 *     cleaning_euler_potentials -out DIR -figures DIR [-full]       (-h for help)
 *
 * A field along the axis of a cylinder, B = e_z, wound up by a given rotation: every layer z turns by theta = Omega t sin 2 pi z, as a rigid body, density does not change. The exact field is that of the frozen
 * lines, B = e_z + r theta' e_phi. By potentials: alpha = x, beta = y of the start, which particles carry with them; B = grad alpha x grad beta with gradients that are exact for linear functions. By the
 * induction equation: (7). Both on the same particles, which move exactly. Windings: the turns of a line of B between z = -1/4 and 1/4, Omega t / pi.
 * The potentials are the places where particles started, and their gradients need neighbours that started near each other: the more layers there are for a winding, the later they are lost. The field of the
 * induction equation needs gradients of the velocity alone, which stays as smooth as it was.
 */
#include "cleaning.h"

enum {
    X,
    Y,
    Z,
    BX,
    BY,
    BZ,
    VX,
    VY,
    VZ,
    RBX,
    RBY,
    RBZ,
    AX,
    AY,
    AZ,
    ALPHA,
    BETA,
    GX,
    GY,
    GZ,
    QX,
    QY,
    QZ,
    KEPT_X,
    KEPT_Y,
    KEPT_Z,
    ARRAYS
};

static const double radius = 0.35;

typedef struct cylinder {
    int n, layers;
    double dx, h, V;
    double *a[ARRAYS];
    search near;
} cylinder;

static cylinder cylinder_new(int layers)
{
    const int side = 2 * (int)ceil(radius * layers);
    cylinder c = {0};
    int pass, i, k;
    c.layers = layers;
    c.dx = 1.0 / layers;
    c.h = CLEANING_ETA * c.dx;
    c.V = c.dx * c.dx * c.dx;
    for (pass = 0; pass < 2; pass++) {
        int n = 0;
        for (i = 0; i < side * side * layers; i++) {
            const double x = (i % side + 0.5 - side / 2) * c.dx,
                         y = (i / side % side + 0.5 - side / 2) * c.dx;
            if (hypot(x, y) > radius) continue;
            if (pass) {
                c.a[ALPHA][n] = x;
                c.a[BETA][n] = y;
                c.a[Z][n] = (i / (side * side) + 0.5) * c.dx - 0.5;
                c.a[BZ][n] = 1;
            }
            n++;
        }
        c.n = n;
        if (!pass) {
            c.a[0] = (double *)need_zeros((size_t)ARRAYS * (size_t)n, sizeof(double));
            for (k = 1; k < ARRAYS; k++) c.a[k] = c.a[0] + k * n;
        }
    }
    return c;
}
static void cylinder_close(cylinder *c)
{
    free(c->a[0]);
    search_close(&c->near);
}
static sph_points points(const cylinder *c)
{
    return sph_points_periodic(sph_points_separate(c->n, c->a[X], c->a[Y], c->a[Z]), 0, 0, 1);
}
static sph_cloud cloud(const cylinder *c)
{
    return sph_cloud_of(points(c), c->near.found.list, sph_scalars_same(&c->h), sph_scalars_same(&c->V));
}
/* Places and velocities where the layers have turned by turn * sin 2 pi z, and the lists */
static void turn_to(cylinder *c, double turn)
{
    const double reach = sph_kernel_support_ratio(SPH_CUBIC_SPLINE) * c->h;
    int i;
    for (i = 0; i < c->n; i++) {
        const double rate = sin(2 * MATH_PI * c->a[Z][i]), theta = turn * rate;
        c->a[X][i] = cos(theta) * c->a[ALPHA][i] - sin(theta) * c->a[BETA][i];
        c->a[Y][i] = sin(theta) * c->a[ALPHA][i] + cos(theta) * c->a[BETA][i];
        c->a[VX][i] = -rate * c->a[Y][i];
        c->a[VY][i] = rate * c->a[X][i];
    }
    search_all(&c->near, 3, points(c), sph_scalars_same(&reach), SPH_LARGER);
}
/* (7), by all of SPMHD for a gas without pressure and dissipation; the time is the angle */
static void induction(cylinder *c)
{
    static const double one = 1, nought = 0;
    sph_mhd s = {0};
    sph_mhd_out out = {0};
    s.medium.m = sph_scalars_same(&c->V);
    s.medium.rho = s.medium.omega = s.cs = sph_scalars_same(&one);
    s.p = s.u = s.alpha = s.alpha_B = sph_scalars_same(&nought);
    s.v = vectors_of(c->a + VX, 3);
    s.field = vectors_of(c->a + BX, 3);
    out.acceleration = vectors_into(c->a + AX, 3);
    out.rate_B = vectors_into(c->a + RBX, 3);
    expect_all(sph_mhd_rates(SPH_CUBIC_SPLINE, 3, cloud(c), s, out));
}
static void step(cylinder *c, double turn, double change) /* midpoint rule */
{
    int i, k;
    turn_to(c, turn);
    induction(c);
    for (k = 0; k < 3; k++)
        for (i = 0; i < c->n; i++) {
            c->a[KEPT_X + k][i] = c->a[BX + k][i];
            c->a[BX + k][i] += 0.5 * change * c->a[RBX + k][i];
        }
    turn_to(c, turn + 0.5 * change);
    induction(c);
    for (k = 0; k < 3; k++)
        for (i = 0; i < c->n; i++) c->a[BX + k][i] = c->a[KEPT_X + k][i] + change * c->a[RBX + k][i];
}

/* What is there of the azimuthal field, away from the surface: sum B . exact / sum exact^2; root of sum (B - exact)^2 / sum exact^2 */
typedef struct match {
    double kept, error;
} match;
enum { POTENTIALS, INDUCTION, WAYS };
static const char *const way_name[WAYS] = {"Euler potentials", "induction equation"};

static match compare(cylinder *c, int way, double turn)
{
    const sph_derivatives_out of_alpha = {.gx = c->a[GX], .gy = c->a[GY], .gz = c->a[GZ]},
                              of_beta = {.gx = c->a[QX], .gy = c->a[QY], .gz = c->a[QZ]};
    double product = 0, square = 0, apart = 0;
    match m;
    int i;
    turn_to(c, turn);
    if (way == POTENTIALS) {
        const sph_scalars alpha = sph_scalars_array(c->a[ALPHA]), beta = sph_scalars_array(c->a[BETA]);
        expect_all(sph_gradient_cspm(SPH_CUBIC_SPLINE, 3, cloud(c), alpha, of_alpha));
        expect_all(sph_gradient_cspm(SPH_CUBIC_SPLINE, 3, cloud(c), beta, of_beta));
    }
    for (i = 0; i < c->n; i++) {
        const double x = c->a[X][i], y = c->a[Y][i], r = hypot(x, y),
                     bend = 2 * MATH_PI * turn * cos(2 * MATH_PI * c->a[Z][i]), exact = r * bend;
        sph_vec B;
        double own;
        if (r > radius - sph_kernel_support_ratio(SPH_CUBIC_SPLINE) * c->h) continue;
        if (way == POTENTIALS) {
            const sph_vec p = {c->a[GX][i], c->a[GY][i], c->a[GZ][i]},
                          q = {c->a[QX][i], c->a[QY][i], c->a[QZ][i]};
            B = sph_euler_potentials(p, q);
        } else {
            B.x = c->a[BX][i];
            B.y = c->a[BY][i];
        }
        own = (x * B.y - y * B.x) / r;
        product += own * exact;
        square += exact * exact;
        apart += (own - exact) * (own - exact);
    }
    m.kept = product / square;
    m.error = sqrt(apart / square);
    return m;
}

enum { PER_WINDING = 16, EVERY = 4, WINDINGS = 3, SAMPLES = WINDINGS * PER_WINDING / EVERY };

/* o[way][sample]; half: windings after which half of the field by potentials is left, between samples */
static double run(int layers, match o[WAYS][SAMPLES + 1], FILE *curves, int quiet)
{
    cylinder c = cylinder_new(layers);
    double half = (double)NAN;
    char label[64];
    progress p;
    int k, way;
    snprintf(label, sizeof label, "%d layers", layers);
    progress_begin(&p, label, quiet);
    for (k = 0; k <= WINDINGS * PER_WINDING; k++) {
        const double change = MATH_PI / PER_WINDING, windings = (double)k / PER_WINDING;
        const int sample = k / EVERY;
        if (k > 0) step(&c, (k - 1) * change, change);
        progress_update(&p, (k + 1.0) / (WINDINGS * PER_WINDING + 1));
        if (k == 0 || k % EVERY) continue;
        for (way = 0; way < WAYS; way++) o[way][sample] = compare(&c, way, k * change);
        if (isnan(half) && o[POTENTIALS][sample].kept < 0.5) {
            const double now = o[POTENTIALS][sample].kept, before = o[POTENTIALS][sample - 1].kept;
            half = windings - (0.5 - now) / (before - now) * EVERY / PER_WINDING;
        }
    }
    progress_end(&p);
    cylinder_close(&c);
    for (way = 0; way < WAYS; way++)
        for (k = 1; k <= SAMPLES; k++)
            fprintf(curves, "%s,%d,%.4g,%.6g,%.6g\n", way_name[way], layers, (double)k * EVERY / PER_WINDING,
                    o[way][k].kept, o[way][k].error);
    return half;
}

int main(int argc, char **argv)
{
    const char *out = ".", *figures = ".";
    int full = 0, quiet = 0, a, k;
    const option_spec specs[] = {
        {"out", "folder of the result table", OPTION_TEXT, &out, 0, 0},
        {"figures", "folder of the figures' data", OPTION_TEXT, &figures, 0, 0},
        {"full", "36 layers, too", OPTION_FLAG, &full, 0, 0},
        {"quiet", "no line of progress", OPTION_FLAG, &quiet, 0, 0},
    };
    enum { SIZES = 4 };
    static const int layers[SIZES] = {16, 24, 32, 36};
    static report r;
    match o[WAYS][SAMPLES + 1];
    double half[SIZES];
    FILE *curves;
    options_parse(argc, argv, "Euler potentials in three dimensions where the flow winds the field up.",
                  specs, 4);
    report_open(&r, "cleaning_euler_potentials", out);
    figure_folder(figures, "cleaning_euler_potentials");
    curves = figure_open(figures, "cleaning_euler_potentials_windings");
    fprintf(curves, "way,layers,windings,kept,error\n");
    for (a = 0; a < (full ? SIZES : SIZES - 1); a++) {
        const int per = PER_WINDING / EVERY;
        char at[64], text[160];
        double worst = 0;
        snprintf(at, sizeof at, "%d layers", layers[a]);
        report_section(&r, at);
        half[a] = run(layers[a], o, curves, quiet);
        for (k = 1; k <= SAMPLES; k++) {
            char what[64];
            worst = fmax(worst, o[INDUCTION][k].error);
            snprintf(what, sizeof what, "azimuthal field after %g windings", (double)k / per);
            snprintf(text, sizeof text,
                     "potentials: %.1f %% left, error %.1f %%; induction equation: %.1f %%, %.1f %%",
                     100 * o[POTENTIALS][k].kept, 100 * o[POTENTIALS][k].error, 100 * o[INDUCTION][k].kept,
                     100 * o[INDUCTION][k].error);
            report_row(&r, "II-A1", at, what, NULL, text, NULL, NULL, REPORT_INFO);
        }
        if (a == 0) {
            snprintf(text, sizeof text,
                     "%.0f %% of the field are left after one, %.0f %% after two, %.0f %% after three",
                     100 * o[POTENTIALS][per].kept, 100 * o[POTENTIALS][2 * per].kept,
                     100 * o[POTENTIALS][3 * per].kept);
            report_claim(&r, "II-A1", at, "windings by Euler potentials",
                         "cannot be modelled past one rotation", text, "< 25 % after two, < 5 % after three",
                         o[POTENTIALS][2 * per].kept < 0.25 && o[POTENTIALS][3 * per].kept < 0.05);
        }
        report_not_reproduced(&r, "II-A1", at, "windings after which potentials have lost half of it", 1, half[a],
                              "a matter of layers per winding, which the paper does not name");
        report_range(report_beside(&r, REPORT_REGRESSION), "II-A1", at, "the same, and 0.075 for each layer", 0.075 * layers[a],
                     half[a], 0.07 * layers[a], 0.08 * layers[a]);
        report_range(report_beside(&r, REPORT_THEORY), "(7)", at, "largest error of the induction equation, to three windings", 0, worst, 0,
                     0.05);
        /* its error is that of grad v, which has nothing to do with windings */
        report_range(report_beside(&r, REPORT_THEORY), "(7)", at, "its error after three windings / after a quarter", 1,
                     o[INDUCTION][SAMPLES].error / o[INDUCTION][1].error, 0, 1.2);
    }
    figure_close(curves);
    report_section(&r, "Resolution");
    for (a = 0; a + 1 < (full ? SIZES : SIZES - 1); a++) {
        char at[64];
        snprintf(at, sizeof at, "%d and %d layers", layers[a], layers[a + 1]);
        report_relative(
            report_beside(&r, REPORT_THEORY), "II-A1", at,
            "windings until half is lost, per layer: ratio (what is lost is a matter of layers per winding)",
            1, half[a + 1] / half[a] * layers[a] / layers[a + 1], 0.03);
    }
    return report_close(&r) ? 1 : 0;
}
