/* SPDX-License-Identifier: MIT
 *
 * elliptic_scatter.h - particles beyond the paper's lattices: an h of each particle's own, periodic boxes, volumes from the density, Poisson discs. What it
 * fills is a cloud of elliptic.h, so that cloud_matrix and elliptic_solve apply; cloud_neighbours and cloud_rows, which have one h and no box, do not.
 *
 *     scatter s = {0};
 *     scatter_cells(&s, 2, 20);                     or scatter_discs(...), or your own positions after scatter_size
 *     scatter_neighbours(&s, 1.2);                  lists for h = 1.2 * s.spacing[i]
 *     scatter_volumes(&s);                          V = 1 / sum W
 *     scatter_rows(&s, SCHEME_M, SCATTER_PLAIN, 0);  s.c.row, s.c.diagonal
 *     scatter_conditions(&s, first, normal, alpha, beta);
 *     scatter_close(&s);
 */
#ifndef ELLIPTIC_SCATTER_H
#define ELLIPTIC_SCATTER_H

#include "elliptic_system.h"

#ifdef __clang__
#pragma clang diagnostic ignored \
    "-Wpass-failed" /* loops that are too much for its vectoriser, in many copies here */
#endif

typedef struct scatter {
    cloud c;
    int inner;       /* particles before this one are inside, the others on the boundary */
    double box[3];   /* 0: open */
    double *spacing; /* of each particle */
    double *h;
    int capacity;
} scatter;

static inline void scatter_size(scatter *s, int dim, int n)
{
    int a;
    cloud_size(&s->c, dim, n);
    if (n > s->capacity) {
        s->spacing = (double *)need(s->spacing, (size_t)n, sizeof(double));
        s->h = (double *)need(s->h, (size_t)n, sizeof(double));
        s->capacity = n;
    }
    s->inner = n;
    for (a = 0; a < 3; a++) {
        s->box[a] = s->c.low[a] = 0;
        s->c.high[a] = 1;
    }
}
static inline void scatter_close(scatter *s)
{
    cloud_close(&s->c);
    free(s->spacing);
    free(s->h);
}

static inline sph_points scatter_points(const scatter *s)
{
    return sph_points_periodic(cloud_points(&s->c), s->box[0], s->box[1], s->box[2]);
}
static inline sph_cloud scatter_cloud(const scatter *s)
{
    return sph_cloud_of(scatter_points(s), search_list(&s->c.lists), sph_scalars_array(s->h),
                        sph_scalars_array(s->c.V));
}

/* N^dim particles in the middle of the cells of the unit square or cube, and 2 dim N^(dim - 1) in the middle of the outer faces of cells, as in section 5
   of the paper. V = dx^dim */
static inline void scatter_cells(scatter *s, int dim, int N)
{
    const int layer = dim == 2 ? N : N * N, inner = layer * N;
    const double dx = 1.0 / N;
    int i, a, b, end, at;
    scatter_size(s, dim, inner + 2 * dim * layer);
    s->c.dx = dx;
    s->inner = inner;
    for (i = 0; i < s->c.n; i++) {
        s->spacing[i] = dx;
        s->c.V[i] = pow(dx, dim);
    }
    for (i = 0; i < inner; i++) {
        const int place[3] = {i % N, i / N % N, i / N / N};
        for (a = 0; a < dim; a++) cloud_axis(&s->c, a)[i] = (place[a] + 0.5) * dx;
    }
    at = inner;
    for (a = 0; a < dim; a++)
        for (end = 0; end < 2; end++)
            for (i = 0; i < layer; i++, at++) {
                int rest = i;
                for (b = 0; b < dim; b++) {
                    if (b == a) cloud_axis(&s->c, b)[at] = end;
                    else {
                        cloud_axis(&s->c, b)[at] = (rest % N + 0.5) * dx;
                        rest /= N;
                    }
                }
            }
    cloud_depths(&s->c);
}

/* -------- Poisson discs: darts are thrown until there is hardly any room, a dart being refused closer than 0.83 (2D) or 0.9 (3D) spacings to another particle.
   Far from walls such packings come to hold 0.70 and 0.73 particles in the square and cube of that distance (random sequential adsorption), which is one in that
   of the spacing. The particles of the faces keep a layer free, so that there are fewer: 9 % in 2D with 40 along a side, 28 % in 3D with 16. */

typedef struct scatter_buckets {
    int side, *first, *next; /* -1 ends a chain */
} scatter_buckets;

static inline int scatter_bucket(const scatter_buckets *b, int dim, const double p[3])
{
    int a, index = 0;
    for (a = dim - 1; a >= 0; a--) {
        const int at = (int)(p[a] * b->side);
        index = index * b->side + (at < 0 ? 0 : at >= b->side ? b->side - 1 : at);
    }
    return index;
}
static inline void scatter_put(scatter *s, scatter_buckets *b, int i, const double p[3], double spacing)
{
    const int bucket = scatter_bucket(b, s->c.dim, p);
    int a;
    for (a = 0; a < s->c.dim; a++) cloud_axis(&s->c, a)[i] = p[a];
    s->spacing[i] = spacing;
    b->next[i] = b->first[bucket];
    b->first[bucket] = i;
}
/* Is a particle closer to p than distance? distance <= 1 / side */
static inline int scatter_occupied(const scatter *s, const scatter_buckets *b, const double p[3],
                                   double distance)
{
    const int nz = s->c.dim > 2;
    int k, a, j;
    for (k = 0; k < (nz ? 27 : 9); k++) {
        const double step = 1.0 / b->side, q[3] = {p[0] + (k % 3 - 1) * step, p[1] + (k / 3 % 3 - 1) * step,
                                                   nz ? p[2] + (k / 9 - 1) * step : 0};
        int outside = 0;
        for (a = 0; a < s->c.dim; a++) outside |= q[a] < 0 || q[a] > 1;
        for (j = outside ? -1 : b->first[scatter_bucket(b, s->c.dim, q)]; j >= 0; j = b->next[j]) {
            double square = 0;
            for (a = 0; a < s->c.dim; a++)
                square += (p[a] - cloud_axis(&s->c, a)[j]) * (p[a] - cloud_axis(&s->c, a)[j]);
            if (square < distance * distance) return 1;
        }
    }
    return 0;
}

/* spacing dx0 (1 + grade x) in the unit square (any grade) or cube (grade 0), with as many particles as N^dim, about; the boundary particles stand evenly
   in their faces */
static inline void scatter_discs(scatter *s, int dim, int N, double grade, pcg32 *g)
{
    const double dx0 =
        dim == 2 ? 1.0 / (N * sqrt(1 + grade)) : 1.0 / N; /* the integral of spacing^-2 is N^2 */
    const double largest = dx0 * (1 + grade), close = dim == 2 ? 0.83 : 0.9;
    const int room = 2 * (dim == 2 ? N * N : N * N * N) + 64 + 8 * dim * (dim == 2 ? N : N * N);
    double *x, *V;
    scatter_buckets b;
    int i, a, end, n = 0, tries, faces, buckets;
    scatter_size(s, dim, room);
    s->c.dx = dx0;
    b.side = (int)floor(1 / (close * largest));
    buckets = dim == 2 ? b.side * b.side : b.side * b.side * b.side;
    b.first = (int *)need(NULL, (size_t)buckets, sizeof(int));
    b.next = (int *)need(NULL, (size_t)room, sizeof(int));
    for (i = 0; i < buckets; i++) b.first[i] = -1;
    for (a = 0; a < dim; a++)
        for (end = 0; end < 2; end++) {
            /* along a face x = const the spacing is even; along the others (1 + grade x) is an exponential of the number of the particle */
            const double there = a == 0 ? dx0 * (1 + grade * end) : dx0,
                         length = a == 0 || grade == 0 ? 1 : log(1 + grade) / grade;
            const int side = (int)floor(length / there + 0.5), count = dim == 2 ? side : side * side;
            for (i = 0; i < count; i++, n++) {
                double p[3] = {0, 0, 0}, q = (i % side + 0.5) / side;
                if (a > 0 && grade > 0) q = expm1(q * log(1 + grade)) / grade;
                p[a] = end;
                p[a == 0 ? 1 : 0] = q;
                if (dim > 2) p[a == 2 ? 1 : 2] = (i / side + 0.5) / side;
                scatter_put(s, &b, n, p, dx0 * (1 + grade * p[0]));
            }
        }
    faces = n;
    for (tries = 0; tries < 60 * (room - faces) && n < room; tries++) {
        const double p[3] = {pcg32_uniform(g), pcg32_uniform(g), dim > 2 ? pcg32_uniform(g) : 0};
        const double spacing = dx0 * (1 + grade * p[0]);
        if (!(pcg32_uniform(g) < pow(1 + grade * p[0], -dim)) || scatter_occupied(s, &b, p, close * spacing))
            continue;
        scatter_put(s, &b, n++, p, spacing);
    }
    free(b.first);
    free(b.next);
    /* inside first, the boundary last */
    V = s->c.V;
    for (a = 0; a <= dim; a++) {
        x = a < dim ? cloud_axis(&s->c, a) : s->spacing;
        for (i = 0; i < n; i++) V[i] = x[i];
        for (i = 0; i < n; i++) x[i < faces ? n - faces + i : i - faces] = V[i];
    }
    s->c.n = n;
    s->inner = n - faces;
    for (i = 0; i < n; i++) V[i] = pow(s->spacing[i], dim);
    cloud_depths(&s->c);
}

/* -------- neighbours, volumes, rows */

/* h = factor * spacing; lists of all pairs with r < support * max(h_i, h_j): what the pair's mean h needs, and the density */
static inline void scatter_neighbours(scatter *s, double factor)
{
    cloud *const c = &s->c;
    double *const radius = (double *)need(NULL, (size_t)c->n, sizeof *radius), largest = 0;
    int i;
    for (i = 0; i < c->n; i++) {
        s->h[i] = factor * s->spacing[i];
        radius[i] = s->h[i] * sph_kernel_support_ratio(ELLIPTIC_KERNEL);
        largest = fmax(largest, radius[i]);
    }
    cloud_search(c, scatter_points(s), SPH_LARGER, sph_scalars_array(radius), largest);
    free(radius);
}

/* V = m / rho = 1 / sum_j W_ij: what a particle code has. At a boundary it is too large, by up to 2^dim. */
static inline void scatter_volumes(scatter *s)
{
    const double one = 1;
    const sph_scalars m = sph_scalars_same(&one);
    const sph_scalar_out out = sph_scalar_out_array(s->c.V, 0);
    int i;
    expect(WITH_DIM_2_3(sph_density_summation, ELLIPTIC_KERNEL, s->c.dim, scatter_cloud(s), m, out));
    for (i = 0; i < s->c.n; i++) s->c.V[i] = 1 / s->c.V[i];
}

/* of the rows: gradient (15), gradient (16), options.trace */
enum { SCATTER_PLAIN, SCATTER_FULL, SCATTER_TRACE };

SPH_FN sph_index scatter_rows_in(int variant, int dim, int harmonic, scatter *s, int scheme)
{
    const sph_cloud all = scatter_cloud(s);
    const sph_scalars m = sph_scalars_array(s->c.m);
    const sph_rows_out out = {.row = s->c.row, .diagonal = s->c.diagonal, .status = s->c.status};
    sph_elliptic_options o = {0};
    if (variant == SCATTER_FULL) o.gradient = SPH_GRADIENT_FULL;
    o.trace = variant == SCATTER_TRACE;
    if (harmonic) o.mean = SPH_MOBILITY_HARMONIC;
    if (scheme == SCHEME_B) return sph_elliptic_rows_brookshaw(ELLIPTIC_KERNEL, dim, all, m, o, out);
    if (scheme == SCHEME_CB)
        return sph_elliptic_rows_brookshaw_corrected(ELLIPTIC_KERNEL, dim, all, m, o, out);
    return sph_elliptic_rows_msph(ELLIPTIC_KERNEL, dim, all, m, o, out);
}
/* full: the gradient (16), else (15); harmonic (in 2D): that mean of m, else the arithmetic. Constants in
   each call, so that the loops fold. */
static inline void scatter_rows(scatter *s, int scheme, int variant, int harmonic)
{
    const int dim = s->c.dim;
    sph_index bad;
    if (variant == SCATTER_TRACE) bad = WITH_DIM_2_3(scatter_rows_in, SCATTER_TRACE, dim, 0, s, scheme);
    else if (variant == SCATTER_FULL) bad = WITH_DIM_2_3(scatter_rows_in, SCATTER_FULL, dim, 0, s, scheme);
    else if (harmonic && dim == 2) bad = scatter_rows_in(SCATTER_PLAIN, 2, 1, s, scheme);
    else bad = WITH_DIM_2_3(scatter_rows_in, SCATTER_PLAIN, dim, 0, s, scheme);
    expect(bad);
}

/* from particle i to the nearest image of j */
static inline sph_vec scatter_separation(const scatter *s, int i, int j)
{
    double e[3];
    sph_vec v;
    int a;
    for (a = 0; a < 3; a++) {
        e[a] = cloud_axis(&s->c, a)[j] - cloud_axis(&s->c, a)[i];
        if (s->box[a] > 0) e[a] -= s->box[a] * floor(e[a] / s->box[a] + 0.5);
    }
    v.x = e[0];
    v.y = e[1];
    v.z = e[2];
    return v;
}

/* What the rows make of |x - x_i|^2, over the exact 2 dim m_i, for arithmetic means of m: the trace of their second moment. M-SPH divides by dim / tr
   Gamma^-1, and tr Gamma tr Gamma^-1 >= dim^2, with = for multiples of the unit tensor only: where the neighbours stand unevenly its rows are too large, in
   the mean, too. A source is then divided by too much, and the error of u stays; a solution without a source does not notice, because rows may be
   multiplied by anything there. */
static inline double scatter_trace(const scatter *s, int i)
{
    double sum = 0;
    int p;
    for (p = s->c.lists.start[i]; p < s->c.lists.start[i + 1]; p++) {
        const int j = s->c.lists.index[p];
        const sph_vec e = scatter_separation(s, i, j);
        sum += s->c.row[p] / (0.5 * (s->c.m[i] + s->c.m[j])) * (e.x * e.x + e.y * e.y + e.z * e.z);
    }
    return sum / (2 * s->c.dim);
}

/* alpha u + beta m du/dn for the particles from `first` on that have one of them */
static inline void scatter_conditions(scatter *s, int first, double *const normal[3], const double *alpha,
                                      const double *beta)
{
    cloud_conditions(&s->c, scatter_cloud(s), first, normal, alpha, beta);
}

/* sqrt(sum V (u - exact)^2 / sum V exact^2) over the inner particles: the relative L2 norm */
static inline double scatter_error(const scatter *s, const double *u, const double *exact)
{
    double above = 0, below = 0;
    int i;
    for (i = 0; i < s->inner; i++) {
        above += s->c.V[i] * (u[i] - exact[i]) * (u[i] - exact[i]);
        below += s->c.V[i] * exact[i] * exact[i];
    }
    return sqrt(above / below);
}

#endif
