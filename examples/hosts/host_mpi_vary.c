/* SPDX-License-Identifier: MIT
 *
 * host_mpi_vary.c - particles with radii that differ by a factor of 18 on many ranks: is every row complete?
 *
 *     mpicc -O2 -I. -I/usr/include/trilinos examples/hosts/host_mpi_vary.c -o host_mpi_vary -ltrilinos_zoltan -lm
 *     mpirun -n 4 ./host_mpi_vary 60000 [periodic]
 *
 * A cloud that is dense in the middle. The pairs of all ranks are counted, and hashed by the global numbers of
 * their particles: count and hash must not depend on the number of ranks. It also prints how many copies there
 * are before and after cloud_prune. With radii of their own pairs count by the larger one (SPH_LARGER).
 */
#include "host_mpi.h"

enum { X, Y, Z, R, FIELDS };
static const int all[] = {X, Y, Z, R};

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
static void fill(cloud *c, int64_t n, int periodic)
{
    const double pi = 3.14159265358979324;
    int64_t id;
    int k;
    for (id = n * c->rank / c->ranks; id < n * (c->rank + 1) / c->ranks; id++) {
        const double r = 0.5 * pow(uniform(id, 0), 1.5), z = 2 * uniform(id, 1) - 1, phi = 2 * pi * uniform(id, 2);
        const int i = cloud_add(c, id);
        c->f[X][i] = 0.5 + r * sqrt(1 - z * z) * cos(phi);
        c->f[Y][i] = 0.5 + r * sqrt(1 - z * z) * sin(phi);
        c->f[Z][i] = 0.5 + r * z;
        /* some 50 neighbours: the density goes as u'(r) / r^2 */
        c->f[R][i] = fmin(0.45, cbrt(60.0 / (double)n) * cbrt(r * r * r + 1e-6) * pow(2 * r + 1e-3, -2.0 / 9));
        for (k = 0; k < 3 && periodic; k++) c->f[k][i] += c->f[k][i] >= 0.5 ? -0.5 : 0.5; /* the middle into the corners */
    }
    for (k = 0; k < 3; k++) c->period[k] = periodic;
}

int main(int argc, char **argv)
{
    const int periodic = argc > 2 && !strcmp(argv[2], "periodic");
    const int64_t n = argc > 1 ? atoi(argv[1]) : 60000;
    cloud c;
    uint64_t hash[2] = {0, 0};
    long long copies[2], before[2], pairs = 0, ids;
    double radii[2] = {0, -1e30};
    int criterion, i;
    sph_index p;
    MPI_Init(&argc, &argv);
    cloud_begin(&c, MPI_COMM_WORLD, 0, FIELDS, FIELDS);
    if (n < 0 || n > 100000000) cloud_stop(&c, "host_mpi_vary N [periodic]", "a number of particles is wanted");
    fill(&c, n, periodic);
    cloud_balance(&c);
    for (i = 0; i < c.n; i++) radii[0] = fmax(radii[0], c.f[R][i]), radii[1] = fmax(radii[1], -c.f[R][i]);
    MPI_Allreduce(MPI_IN_PLACE, radii, 2, MPI_DOUBLE, MPI_MAX, c.comm);
    for (criterion = SPH_GATHER; criterion <= SPH_LARGER; criterion += SPH_LARGER - SPH_GATHER) {
        cloud_halo(&c, sph_scalars_array(c.f[R]), criterion); /* arrays may move here: views are made anew */
        cloud_exchange(&c, FIELDS, all);
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
    cloud_end(&c);
    MPI_Finalize();
    return 0;
}
