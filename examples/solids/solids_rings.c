/* SPDX-License-Identifier: MIT
 *
 * solids_rings.c - two rubber rings collide, flatten, and part again.
 *
 *     cc -O2 -o solids_rings examples/solids/solids_rings.c -lm
 *     solids_rings -out DIR -figures DIR [-full]       (-h for help)
 *
 * Rings with the radii 3 and 4, which meet with 0.12 times the speed of sound (Gray, Monaghan & Swift 2001, CMAME
 * 190, 6641; there the rings break where the tensile instability is not removed). Saint Venant & Kirchhoff,
 * nu = 0.4, h = dx, 5 particles across a ring (with -full 10). Where particles of different rings are nearer than
 * dx, they push each other with E dx (1 - r / dx), along the line between them. What is asked: that momentum,
 * angular momentum and energy are kept, and that the rings part whole.
 */
#include "solids.h"

typedef struct contact {
    search near;
    int first; /* particle of the second ring */
    int pairs;
} contact;

static void push_apart(body *b)
{
    contact *const c = (contact *)b->others;
    const double reach = b->dx;
    int i;
    sph_index p;
    search_all(&c->near, 2, body_points(b), sph_scalars_same(&reach), SPH_GATHER);
    c->pairs = 0;
    for (i = 0; i < b->n; i++)
        for (p = c->near.found.list.start[i]; p < c->near.found.list.start[i + 1]; p++) {
            const int j = (int)c->near.found.list.index[p];
            const double x = b->x[0][i] - b->x[0][j], y = b->x[1][i] - b->x[1][j], r = hypot(x, y);
            double push;
            if ((i < c->first) == (j < c->first) || !(r > 0) || r > reach) continue;
            push = b->young * b->dx * (1 - r / reach) / (b->density[i] * b->volume[i] * r);
            b->a[0][i] += push * x;
            b->a[1][i] += push * y;
            c->pairs++;
        }
}
static double middle(const body *b, const contact *c, int second)
{
    double sum = 0;
    int i;
    for (i = second ? c->first : 0; i < (second ? b->n : c->first); i++) sum += b->x[0][i];
    return sum / (second ? b->n - c->first : c->first);
}

int main(int argc, char **argv)
{
    static const double inner = 3, outer = 4, apart = 8.6, speed = 0.06, end = 200;
    solids_options o = {".", ".", 0, 0};
    const option_spec specs[] = {SOLIDS_OPTIONS(o)};
    static report r;
    static contact c;
    static const double moments[6] = {0, 25, 50, 80, 120, 199};
    double dx, t = 0, dt, start, kinetic, nearest, flattest = 1, smallest_J = 1, before, after;
    body_totals last;
    progress show;
    body b;
    int i, side, ring, due = 0, contacts = 0;
    options_parse(argc, argv, "Two rubber rings collide.", specs, SOLIDS_OPTION_COUNT);
    report_open(&r, "solids_rings", o.out);
    figure_folder(o.figures, "solids_rings");
    dx = o.full ? 0.1 : 0.2;
    side = (int)(outer / dx + 0.5);
    body_open(&b, dx, dx, sph_elastic_of(1.4 * 0.2 / 0.6, 0.4), BODY_SAINT_VENANT_KIRCHHOFF);
    for (ring = 0; ring < 2; ring++) {
        c.first = ring ? b.n : 0;
        for (i = 0; i < 4 * side * side; i++) {
            const double x = (i % (2 * side) + 0.5) * dx - outer, y = (i / (2 * side) + 0.5) * dx - outer, q = hypot(x, y);
            if (q > inner && q < outer) body_add(&b, x + (ring ? 0.5 : -0.5) * apart, y);
        }
    }
    body_start(&b);
    for (i = 0; i < b.n; i++) b.v[0][i] = i < c.first ? speed : -speed;
    b.others = &c;
    b.push = push_apart;
    start = body_energy(&b);
    kinetic = body_sums(&b).kinetic;
    nearest = before = middle(&b, &c, 1) - middle(&b, &c, 0);
    dt = 0.5 * body_time_step(&b);
    progress_begin(&show, "rings", o.quiet);
    while (t < end) {
        double now;
        if (due < 6 && t >= moments[due]) {
            char name[64];
            snprintf(name, sizeof name, "solids_rings_%d", due++);
            body_write(&b, o.figures, name);
        }
        body_step(&b, dt);
        t += dt;
        now = middle(&b, &c, 1) - middle(&b, &c, 0);
        nearest = fmin(nearest, now);
        flattest = fmin(flattest, body_sums(&b).kinetic / kinetic);
        contacts += c.pairs > 0;
        for (i = 0; i < b.n; i++) {
            const double *const F = b.gradient + 4 * i;
            smallest_J = fmin(smallest_J, F[0] * F[3] - F[1] * F[2]);
        }
        progress_update(&show, t / end);
    }
    after = middle(&b, &c, 1) - middle(&b, &c, 0);
    last = body_sums(&b);
    report_section(&r, "Two rings");
    report_range(report_beside(&r, REPORT_THEORY), "rings", "t = 200", "momentum / that of one ring", 0,
                 hypot(last.momentum[0], last.momentum[1]) / (0.5 * kinetic / (0.5 * speed)), 0, 1e-10);
    report_range(report_beside(&r, REPORT_THEORY), "rings", "t = 200", "angular momentum / that of one ring", 0,
                 fabs(last.angular) / (0.5 * kinetic / (0.5 * speed) * outer), 0, 1e-10);
    report_range(report_beside(&r, REPORT_THEORY), "rings", "t = 200", "energy / that of the start", 1,
                 body_energy(&b) / start, 0.98, 1.02);
    report_range(&r, "rings", "t = 200", "distance of the middles / that of the start: they part", (double)NAN,
                 after / before, 1.05, 3);
    report_range(&r, "rings", "all times", "least distance of the middles / that of the start: they flatten", (double)NAN,
                 nearest / before, 0.4, 0.95);
    report_range(&r, "rings", "all times", "least det F: no particle is turned inside out", (double)NAN, smallest_J, 0.5, 1);
    report_info(&r, "rings", "all times", "least kinetic energy / that of the start", flattest);
    report_info(&r, "rings", "t = 200", "kinetic energy / that of the start: the rest makes the rings tremble", last.kinetic / kinetic);
    report_info(&r, "rings", "all times", "share of the time in contact", contacts * dt / end);
    search_close(&c.near);
    body_close(&b);
    return report_close(&r) ? 1 : 0;
}
