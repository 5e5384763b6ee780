/* SPDX-License-Identifier: MIT
 *
 * host_mpi_vary.c - particles with radii that differ by a factor of 18 on many ranks: is every row complete?
 *
 *     mpicc -O2 -I. -I/usr/include/trilinos examples/hosts/host_mpi_vary.c -o host_mpi_vary -ltrilinos_zoltan -lm
 *     mpirun -n 4 ./host_mpi_vary 60000 [LENGTH]             LENGTH: 1 or more, of a periodic box
 *
 * A cloud that is dense in the middle. The pairs of all ranks are counted, and hashed by the global numbers of
 * their particles: count and hash must not depend on the number of ranks. It also prints how many copies there
 * are before and after cloud_prune. With radii of their own pairs count by the larger one (SPH_LARGER).
 *
 * Then smoothing lengths are made to follow the density, from guesses with lists that are too short: where h
 * turns out to be longer than a list allows, the list's radius grows, and with it the halo, until all are long
 * enough. h, density and Omega must have the same bits on any number of ranks.
 */
#include "host_mpi.h"

enum { X, Y, Z, R, M, GUESS, MOVED, H = MOVED, RHO, OMEGA, FIELDS };
#define KERNEL SPH_WENDLAND_C2
static const int all[] = {X, Y, Z, R, M};

static uint64_t mixed(uint64_t a)
{
    a = (a ^ a >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    a = (a ^ a >> 27) * UINT64_C(0x94d049bb133111eb);
    return a ^ a >> 31;
}
static double uniform(int64_t number, int which) /* in 0 ... 1, by the number alone: the same on any rank */
{
    return (double)(mixed((uint64_t)(3 * number + which) * UINT64_C(0x9e3779b97f4a7c15)) >> 11) / 9007199254740992.0;
}
static void fill(cloud *c, int64_t n, double length)
{
    const double pi = 3.14159265358979324;
    int64_t id;
    int k;
    for (id = n * c->rank / c->ranks; id < n * (c->rank + 1) / c->ranks; id++) {
        const double r = 0.5 * pow(uniform(id, 0), 1.5), z = 2 * uniform(id, 1) - 1, phi = 2 * pi * uniform(id, 2);
        const int i = cloud_add(c, id);
        c->f[M][i] = 1.0 / (double)n;
        c->f[X][i] = 0.5 + r * sqrt(1 - z * z) * cos(phi);
        c->f[Y][i] = 0.5 + r * sqrt(1 - z * z) * sin(phi);
        c->f[Z][i] = 0.5 + r * z;
        /* some 50 neighbours: the density goes as u'(r) / r^2 */
        c->f[R][i] = fmin(0.45, cbrt(60.0 / (double)n) * cbrt(r * r * r + 1e-6) * pow(2 * r + 1e-3, -2.0 / 9));
        for (k = 0; k < 3 && length > 0; k++) c->f[k][i] += c->f[k][i] >= 0.5 ? -0.5 : 0.5; /* the middle into the corners */
    }
    for (k = 0; k < 3; k++) c->period[k] = length;
}
static long long sum_of(const cloud *c, long long mine)
{
    MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_LONG_LONG, MPI_SUM, c->comm);
    return mine;
}
static uint64_t bits(double a)
{
    uint64_t b;
    memcpy(&b, &a, sizeof b);
    return mixed(b);
}
/* h that follows the density. R: the radius of each list, which grows. Rows must be those of one rank, and so must
   the guesses: h is found to a tolerance only. */
static void adapt(cloud *c)
{
    const double longest = c->period[0] > 0 ? c->period[0] / 2 : 1000;
    const int64_t total = sum_of(c, c->n);
    unsigned char *const status = cloud_memory(c, NULL, (size_t)c->n, 1);
    uint64_t hash[2] = {0, 0};
    double ends[2] = {-1e30, -1e30};
    long long first = -1, copies = 0, again = 1, lonely = 0;
    int rounds = 0, i;
    for (i = 0; i < c->n; i++) {
        c->f[R][i] *= 0.4;
        c->f[GUESS][i] = c->f[R][i] / 4;
    }
    while (again) {
        cloud_halo(c, sph_scalars_array(c->f[R]), SPH_GATHER);
        cloud_exchange(c, 5, all);
        cloud_exchange_numbers(c, c->number);
        cloud_lists(c, sph_scalars_array(c->f[R]), SPH_GATHER, CLOUD_SORTED);
        cloud_prune(c);
        copies = sum_of(c, c->n_total - c->n);
        if (first < 0) first = copies;
        if (c->n > 0) memcpy(c->f[H], c->f[GUESS], (size_t)c->n * sizeof(double));
        {
            const sph_density_options options = {.list_radius = sph_scalars_array(c->f[R]), .eta = 1.3};
            const sph_density_out out = {.h = c->f[H], .rho = c->f[RHO], .omega = c->f[OMEGA], .status = status};
            const sph_index answer =
                sph_density_adaptive(KERNEL, 3, cloud_view(c, sph_scalars_none(), sph_scalars_none()), sph_scalars_array(c->f[M]), options, out);
            if (answer < 0) cloud_need(c, answer, "sph_density_adaptive");
        }
        for (again = lonely = 0, i = 0; i < c->n; i++) {
            /* "too few" may only mean that this rank knows of no more */
            const int short_of = status[i] == SPH_LIST_TOO_SHORT || (status[i] == SPH_TOO_FEW && c->n_total < total);
            const int grows = short_of && c->f[R][i] < longest;
            if (status[i] != SPH_OK && status[i] != SPH_TOO_FEW && !grows) cloud_stop(c, "sph_density_adaptive", sph_status_text(status[i]));
            if (grows) c->f[R][i] = fmin(1.25 * c->f[R][i], longest);
            again += grows;
            lonely += status[i] == SPH_TOO_FEW && !grows;
        }
        again = sum_of(c, again);
        rounds++;
    }
    for (i = 0; i < c->n; i++) {
        hash[0] += mixed((uint64_t)c->number[i] + bits(c->f[H][i]) + 3 * bits(c->f[RHO][i]) + 5 * bits(c->f[OMEGA][i]));
        ends[0] = fmax(ends[0], c->f[H][i]);
        ends[1] = fmax(ends[1], -c->f[H][i]);
    }
    MPI_Allreduce(&hash[0], &hash[1], 1, MPI_UINT64_T, MPI_SUM, c->comm);
    MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MAX, c->comm);
    lonely = sum_of(c, lonely);
    if (c->rank == 0 && total > 0)
        printf("adaptive h %.9f to %.9f hash %016llx rounds %d alone %lld; halo first %lld last %lld\n", -ends[1], ends[0],
               (unsigned long long)hash[1], rounds, lonely, first, copies);
    free(status);
}

int main(int argc, char **argv)
{
    const double length = argc > 2 ? atof(argv[2]) : 0;
    const int64_t n = argc > 1 ? atoi(argv[1]) : 60000;
    cloud c;
    uint64_t hash[2] = {0, 0};
    long long copies[2], before[2], pairs = 0, ids;
    double radii[2] = {0, -1e30};
    int criterion, i;
    sph_index p;
    MPI_Init(&argc, &argv);
    cloud_begin(&c, MPI_COMM_WORLD, 0, MOVED, FIELDS);
    if (n < 0 || n > 100000000) cloud_stop(&c, "host_mpi_vary N [LENGTH]", "a number of particles is wanted");
    fill(&c, n, length);
    cloud_balance(&c);
    for (i = 0; i < c.n; i++) radii[0] = fmax(radii[0], c.f[R][i]), radii[1] = fmax(radii[1], -c.f[R][i]);
    MPI_Allreduce(MPI_IN_PLACE, radii, 2, MPI_DOUBLE, MPI_MAX, c.comm);
    for (criterion = SPH_GATHER; criterion <= SPH_LARGER; criterion += SPH_LARGER - SPH_GATHER) {
        cloud_halo(&c, sph_scalars_array(c.f[R]), criterion); /* arrays may move here: views are made anew */
        cloud_exchange(&c, 5, all);
        cloud_exchange_numbers(&c, c.number);
        copies[0] = c.n_total - c.n;
        cloud_lists(&c, sph_scalars_array(c.f[R]), criterion, CLOUD_ORDERED);
        cloud_prune(&c);
        copies[1] = c.n_total - c.n;
        for (i = c.n; i < c.n_total; i++) c.number[i] = -1; /* and again by the plan that is left */
        cloud_exchange_numbers(&c, c.number);
        hash[0] = 0;
        pairs = c.pairs;
        for (i = 0; i < c.n; i++)
            for (p = c.start[i]; p < c.start[i + 1]; p++)
                hash[0] += mixed((uint64_t)c.number[i] * UINT64_C(0x9e3779b97f4a7c15) + (uint64_t)c.number[c.index[p]]);
        MPI_Allreduce(&hash[0], &hash[1], 1, MPI_UINT64_T, MPI_SUM, c.comm);
        MPI_Allreduce(MPI_IN_PLACE, &pairs, 1, MPI_LONG_LONG, MPI_SUM, c.comm);
        MPI_Allreduce(copies, before, 2, MPI_LONG_LONG, MPI_SUM, c.comm);
        ids = c.n;
        MPI_Allreduce(MPI_IN_PLACE, &ids, 1, MPI_LONG_LONG, MPI_SUM, c.comm);
        if (c.rank == 0)
            printf("%s pairs %lld hash %016llx of %lld particles, largest radius / smallest %.1f; copies %lld, pruned %lld\n",
                   criterion == SPH_GATHER ? "gather" : "larger", pairs, (unsigned long long)hash[1], ids, ids ? -radii[0] / radii[1] : 1,
                   before[0], before[1]);
    }
    adapt(&c);
    cloud_end(&c);
    MPI_Finalize();
    return 0;
}
