/* SPDX-License-Identifier: MIT
 *
 * host_mpi_dam.c - a column of water collapses in a channel, in three dimensions and on many ranks.
 *
 *     mpicc -O2 -I. -I/usr/include/trilinos examples/hosts/host_mpi_dam.c -o host_mpi_dam \
 *         $(pkg-config --cflags --libs hdf5-openmpi) -ltrilinos_zoltan -lm
 *     mpirun -n 4 ./host_mpi_dam -resolution 16 -steps 2000 -write dam -every 500
 *     mpirun -n 2 ./host_mpi_dam -resolution 16 -steps 4000 -restart dam.h5
 *
 * Weakly compressible SPH: a column of A x 2 A x A in a channel of 5 A, whose walls are fixed particles with
 * densities of their own; -resolution particles across A. Owners, migration, halo and lists by host_mpi.h. In a
 * step two exchanges: velocities, before the rate of density is summed, and positions with densities. While they
 * are on their way, rows that name no copies are swept. Lists have
 * a skin and are kept until a particle has moved by half of it; then particles go to their owners, and the cuts
 * are made anew if a rank has 1.1 times the mean work or more.
 *
 *   -write NAME     the end as NAME.h5, with NAME.xmf for ParaView; with -every N also each N steps, and with -keep
 *                   each of these as NAME_STEP.h5. The layout is that of Gadget and SWIFT (PartType0/Coordinates ...).
 *                   A file is written as NAME.h5.part by all ranks, and renamed when the disk has it: whatever
 *                   ends the run in the middle leaves the one before as it was
 *   -restart FILE   goes on from there, on any number of ranks, with the same -resolution
 *   -sorted         rows in the order of global numbers: the same bits on any number of ranks, and the same as
 *                   without a stop, if files were written at the same steps
 *   -progress N     a line each N steps
 *   -parts N        the first N ranks own all particles
 *   -compare FILE   prints how far all particles are from those of a file, which each rank reads whole
 *   -halo FACTOR    chooses copies for FACTOR times the radius: below 1 an error, which this is to show
 *   -break STEP     kills the last rank in the middle of the file of this step: for the test of that
 */
#define _POSIX_C_SOURCE 200809L
#include "host_mpi.h"
#include <fcntl.h>
#include <hdf5.h>
#include <signal.h>
#include <unistd.h>

enum { X, Y, Z, VX, VY, VZ, RHO, MASS, WALL, MOVED, P = MOVED, AX, AY, AZ, RATE, VOLUME, OLDX, OLDY, OLDZ, FIELDS };
#define KERNEL SPH_WENDLAND_C2
static const double gravity = 9.81, skin = 0.3; /* in spacings */
static const sph_tait water = {.rho0 = 1000, .c = 62.6, .gamma = 7}; /* ten times the largest speed, sqrt(2 g 2 A) */
static double spacing, h, dt;

typedef struct options {
    int resolution, steps, every, keep, sorted, progress, parts, stop_at;
    double halo;
    const char *write, *restart, *compare;
} options;

/* ---------------------------------------------------------------- beginning */

/* Numbers run through a lattice; each rank takes its share of them. Returns how many there are. */
static int64_t fill(cloud *c, int r)
{
    const int layers = 3;
    int64_t id = 0, all = 0;
    int i, j, k, pass;
    for (pass = 0; pass < 2; pass++) /* first only counts */
        for (all = id, id = 0, i = -layers; i < 5 * r + layers; i++)
            for (j = -layers; j < 3 * r; j++)
                for (k = -layers; k < r + layers; k++) {
                    const int wall = i < 0 || i >= 5 * r || j < 0 || k < 0 || k >= r;
                    if (!wall && (i >= r || j >= 2 * r)) continue;
                    if (pass && id >= all * c->rank / c->ranks && id < all * (c->rank + 1) / c->ranks) {
                        const int at = cloud_add(c, id);
                        c->f[X][at] = (i + 0.5) * spacing;
                        c->f[Y][at] = (j + 0.5) * spacing;
                        c->f[Z][at] = (k + 0.5) * spacing;
                        c->f[RHO][at] = sph_density_tait(wall ? 0 : water.rho0 * gravity * (2 - c->f[Y][at]), water);
                        c->f[MASS][at] = c->f[RHO][at] * spacing * spacing * spacing;
                        c->f[WALL][at] = wall;
                    }
                    id++;
                }
    return id;
}

/* ---------------------------------------------------------------- a step */

static void find_neighbours(cloud *c, const options *o, int balance)
{
    static const int sent[] = {X, Y, Z, VX, VY, VZ, RHO, MASS};
    const double reach = sph_kernel_support_ratio(KERNEL) * h + skin * spacing, chosen = o->halo * reach;
    int i, k;
    if (balance) cloud_balance(c);
    else cloud_migrate(c);
    cloud_halo(c, sph_scalars_same(&chosen), SPH_GATHER);
    cloud_exchange(c, 8, sent);
    if (o->sorted) cloud_exchange_numbers(c, c->number);
    cloud_clock(c, -1);
    cloud_lists(c, sph_scalars_same(&reach), SPH_GATHER, (o->sorted ? CLOUD_SORTED : 0) | (balance ? CLOUD_ORDERED : 0));
    cloud_inner(c);
    cloud_clock(c, 1);
    for (i = 0; i < c->n; i++) c->weight[i] = 10 + c->start[i + 1] - c->start[i]; /* a particle's work: some ten pairs, and its own */
    for (k = 0; k < 3; k++) memcpy(c->f[OLDX + k], c->f[X + k], (size_t)c->n * sizeof(double));
}
/* what follows from the density, of particles from ... to - 1 */
static void pressures(cloud *c, int from, int to)
{
    int i;
    for (i = from; i < to; i++) {
        c->f[P][i] = sph_pressure_tait(c->f[RHO][i], water);
        c->f[VOLUME][i] = c->f[MASS][i] / c->f[RHO][i];
    }
}
/* 1 if the lists were made anew, 2 if the cuts were, too */
static int step(cloud *c, const options *o)
{
    static const double one = 1;
    static const int velocity[] = {VX, VY, VZ}, place[] = {X, Y, Z, RHO};
    const sph_scalars length = sph_scalars_same(&h), none = sph_scalars_none();
    const sph_cloud inner = cloud_view_inner(c, length, none), outer = cloud_view_outer(c, length, none);
    const sph_scalars density = sph_scalars_array(c->f[RHO]), unit = sph_scalars_same(&one), sound = {&water.c, 0};
    const sph_vectors v = sph_vectors_separate(c->f[VX], c->f[VY], c->f[VZ]);
    const sph_fluid fluid = {sph_scalars_array(c->f[MASS]), density, sph_scalars_array(c->f[P]), sound, v, SPH_VISCOSITY_MONAGHAN, 0.05, 0, 0.1};
    const sph_medium volumes = {sph_scalars_array(c->f[VOLUME]), unit, unit}; /* of the neighbours: densities may jump */
    const sph_fluid_out force = {.acceleration = sph_vector_out_separate(c->f[AX], c->f[AY], c->f[AZ])};
    const sph_scalar_out rate = sph_scalar_out_array(c->f[RATE], NULL);
    int i, k, due, balance;
    cloud_clock(c, -1);
    pressures(c, 0, c->n);
    cloud_need(c, sph_fluid_rates_colagrossi(KERNEL, 3, inner, fluid, force), "sph_fluid_rates_colagrossi");
    cloud_clock(c, 1);
    cloud_exchange_finish(c); /* places and densities, since the step before */
    cloud_clock(c, -1);
    pressures(c, c->n, c->n_total);
    cloud_need(c, sph_fluid_rates_colagrossi(KERNEL, 3, outer, fluid, force), "sph_fluid_rates_colagrossi");
    cloud_clock(c, 1);
    for (i = 0; i < c->n; i++)
        if (!(c->f[WALL][i] > 0)) {
            c->f[VX][i] += dt * c->f[AX][i];
            c->f[VY][i] += dt * (c->f[AY][i] - gravity);
            c->f[VZ][i] += dt * c->f[AZ][i];
        }
    cloud_exchange_start(c, 3, velocity);
    cloud_clock(c, -1);
    cloud_need(c, sph_divergence_difference(KERNEL, 3, inner, volumes, v, rate), "sph_divergence_difference");
    cloud_clock(c, 1);
    cloud_exchange_finish(c);
    cloud_clock(c, -1);
    cloud_need(c, sph_divergence_difference(KERNEL, 3, outer, volumes, v, rate), "sph_divergence_difference");
    cloud_clock(c, 1);
    for (i = 0; i < c->n; i++) {
        c->f[RHO][i] *= 1 - dt * c->f[RATE][i];
        for (k = 0; k < 3; k++) c->f[X + k][i] += dt * c->f[VX + k][i]; /* walls have the velocity 0 */
    }
    due = sph_rebuild_due(3, cloud_points(c, c->n), sph_points_separate(c->n, c->f[OLDX], c->f[OLDY], c->f[OLDZ]), skin * spacing);
    if (due < 0) cloud_need(c, due, "sph_rebuild_due");
    MPI_Allreduce(MPI_IN_PLACE, &due, 1, MPI_INT, MPI_MAX, c->comm);
    if (!due) {
        cloud_exchange_start(c, 4, place);
        return 0;
    }
    balance = cloud_imbalance(c) > 1.1;
    find_neighbours(c, o, balance);
    return 1 + balance;
}

/* ---------------------------------------------------------------- files */

static const struct {
    const char *name;
    int field, width; /* -1: the numbers */
} stored[] = {{"Coordinates", X, 3}, {"Velocities", VX, 3}, {"Density", RHO, 1}, {"Masses", MASS, 1}, {"Wall", WALL, 1}, {"ParticleIDs", -1, 1}};
enum { STORED = sizeof stored / sizeof *stored };

static hid_t file_need(const cloud *c, hid_t answer, const char *name, const char *why)
{
    if (answer < 0) cloud_stop(c, name, why);
    return answer;
}
static void put_attribute(const cloud *c, hid_t group, const char *name, hid_t type, hsize_t count, const void *value)
{
    const hid_t space = count > 1 ? H5Screate_simple(1, &count, NULL) : H5Screate(H5S_SCALAR);
    const hid_t a = file_need(c, H5Acreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT), name, "cannot write this attribute");
    file_need(c, H5Awrite(a, type, value), name, "cannot write this attribute");
    H5Aclose(a), H5Sclose(space);
}
static void get_attribute(const cloud *c, hid_t group, const char *file, const char *name, hid_t type, void *value)
{
    static const char why[] = "this is no file of host_mpi_dam: an attribute of its header is missing";
    const hid_t a = file_need(c, H5Aexists(group, name) > 0 ? H5Aopen(group, name, H5P_DEFAULT) : -1, file, why);
    const hid_t space = H5Aget_space(a);
    file_need(c, H5Sget_simple_extent_npoints(space) == 1 ? H5Aread(a, type, value) : -1, file, why);
    H5Aclose(a), H5Sclose(space);
}
/* rows first ... first + count - 1 of a data set, of which each rank has some: to the file, or from it */
static void transfer(const cloud *c, hid_t data, hid_t how, const char *file, int set, int writes, hsize_t first, hsize_t count)
{
    const int width = stored[set].width, field = stored[set].field;
    const hsize_t from[2] = {first, 0}, size[2] = {count, (hsize_t)width};
    const hid_t type = field < 0 ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE, space = H5Dget_space(data), mine = H5Screate_simple(width > 1 ? 2 : 1, size, NULL);
    double *const buffer = cloud_memory(c, NULL, count * (size_t)width, sizeof *buffer);
    void *const values = field < 0 ? (void *)c->number : (void *)buffer;
    hsize_t i;
    int k;
    if (count) H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, size, NULL);
    else H5Sselect_none(space), H5Sselect_none(mine); /* all ranks take part */
    for (i = 0; writes && field >= 0 && i < count; i++)
        for (k = 0; k < width; k++) buffer[i * (hsize_t)width + (hsize_t)k] = c->f[field + k][i];
    file_need(c, writes ? H5Dwrite(data, type, mine, space, how, values) : H5Dread(data, type, mine, space, how, values), file, stored[set].name);
    for (i = 0; !writes && field >= 0 && i < count; i++)
        for (k = 0; k < width; k++) c->f[field + k][i] = buffer[i * (hsize_t)width + (hsize_t)k];
    H5Sclose(mine), H5Sclose(space);
    free(buffer);
}
/* Has the disk what was written to this file, so that nothing but the whole of it can be found after a crash? */
static int on_disk(const char *name)
{
    const int file = open(name, O_RDONLY), ok = file >= 0 && fsync(file) == 0;
    if (file >= 0) close(file);
    return ok;
}
/* what tells ParaView (its reader "Xdmf3") what the numbers in NAME.h5 are */
static int write_xdmf(const char *path, const char *base, double time, long long all)
{
    const char *const name = strrchr(base, '/') ? strrchr(base, '/') + 1 : base;
    FILE *const file = fopen(path, "w");
    int set;
    if (!file) return 0;
    fprintf(file, "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"particles\" GridType=\"Uniform\">\n<Time Value=\"%.9g\"/>\n"
                  "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%lld\"/>\n", time, all);
    for (set = 0; set < STORED; set++) {
        const int vector = stored[set].width > 1;
        if (set == 0) fprintf(file, "<Geometry GeometryType=\"XYZ\">\n");
        else fprintf(file, "<Attribute Name=\"%s\" AttributeType=\"%s\" Center=\"Node\">\n", stored[set].name, vector ? "Vector" : "Scalar");
        fprintf(file, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"8\" Dimensions=\"%lld%s\">%s.h5:/PartType0/%s</DataItem>\n",
                stored[set].field < 0 ? "Int" : "Float", all, vector ? " 3" : "", name, stored[set].name);
        fprintf(file, set == 0 ? "</Geometry>\n" : "</Attribute>\n");
    }
    fprintf(file, "</Grid>\n</Domain>\n</Xdmf>\n");
    return fclose(file) == 0;
}
/* by all ranks together, each its own particles; whole, or not at all */
static void write_file(cloud *c, const options *o, const char *base, int steps)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS), together = H5Pcreate(H5P_DATASET_XFER);
    const double time = steps * dt, box[3] = {5, 3, 1}, masses[6] = {0};
    const int files = 1;
    char name[1100], part[1110], picture[1100], picture_part[1110];
    long long n = c->n, first = 0, all;
    long long counts[6] = {0};
    hid_t file, header, group;
    int set, ok = 0;
    snprintf(name, sizeof name, "%s.h5", base);
    snprintf(part, sizeof part, "%s.part", name);
    snprintf(picture, sizeof picture, "%s.xmf", base);
    snprintf(picture_part, sizeof picture_part, "%s.part", picture);
    MPI_Exscan(&n, &first, 1, MPI_LONG_LONG, MPI_SUM, c->comm);
    if (c->rank == 0) first = 0;
    MPI_Allreduce(&n, &all, 1, MPI_LONG_LONG, MPI_SUM, c->comm);
    counts[0] = all;
    H5Pset_fapl_mpio(access, c->comm, MPI_INFO_NULL);
    H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE);
    file = file_need(c, H5Fcreate(part, H5F_ACC_TRUNC, H5P_DEFAULT, access), part, "cannot write this file");
    header = file_need(c, H5Gcreate2(file, "Header", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), part, "cannot write this file");
    put_attribute(c, header, "NumPart_ThisFile", H5T_NATIVE_LLONG, 6, counts);
    put_attribute(c, header, "NumPart_Total", H5T_NATIVE_LLONG, 6, counts);
    put_attribute(c, header, "MassTable", H5T_NATIVE_DOUBLE, 6, masses);
    put_attribute(c, header, "BoxSize", H5T_NATIVE_DOUBLE, 3, box);
    put_attribute(c, header, "NumFilesPerSnapshot", H5T_NATIVE_INT, 1, &files);
    put_attribute(c, header, "Time", H5T_NATIVE_DOUBLE, 1, &time);
    put_attribute(c, header, "HostMpiDamStep", H5T_NATIVE_INT, 1, &steps);
    put_attribute(c, header, "HostMpiDamResolution", H5T_NATIVE_INT, 1, &o->resolution);
    H5Gclose(header);
    group = file_need(c, H5Gcreate2(file, "PartType0", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), part, "cannot write this file");
    for (set = 0; set < STORED; set++) {
        const hsize_t size[2] = {(hsize_t)all, (hsize_t)stored[set].width};
        const hid_t space = H5Screate_simple(stored[set].width > 1 ? 2 : 1, size, NULL);
        const hid_t type = stored[set].field < 0 ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE;
        const hid_t data = file_need(c, H5Dcreate2(group, stored[set].name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), part, "cannot write this file");
        transfer(c, data, together, part, set, 1, (hsize_t)first, (hsize_t)n);
        H5Dclose(data), H5Sclose(space);
        if (set == STORED / 2 && steps == o->stop_at && c->rank == c->ranks - 1) raise(SIGKILL);
    }
    H5Gclose(group);
    file_need(c, H5Fflush(file, H5F_SCOPE_GLOBAL), part, "cannot write this file"); /* from each machine */
    file_need(c, H5Fclose(file), part, "cannot write this file");
    H5Pclose(access), H5Pclose(together);
    if (c->rank == 0)
        ok = on_disk(part) && write_xdmf(picture_part, base, time, all) && on_disk(picture_part) && rename(part, name) == 0 &&
             rename(picture_part, picture) == 0;
    MPI_Bcast(&ok, 1, MPI_INT, 0, c->comm);
    if (!ok) cloud_stop(c, name, "cannot write this file, or the .xmf beside it");
}
/* Each rank of comm its share of a file's particles, whose number must be `wanted`. */
static void read_file(cloud *c, MPI_Comm comm, const char *name, int resolution, int64_t wanted, int *steps)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS), together = H5Pcreate(H5P_DATASET_XFER);
    hid_t file, header, group;
    int64_t first, n;
    int rank, ranks, set, other;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &ranks);
    H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL);
    H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE);
    file = file_need(c, H5Fopen(name, H5F_ACC_RDONLY, access), name, "this file does not exist, or is no HDF5 file");
    header = file_need(c, H5Lexists(file, "Header", H5P_DEFAULT) > 0 ? H5Gopen2(file, "Header", H5P_DEFAULT) : -1, name, "this is no file of host_mpi_dam: it has no header");
    get_attribute(c, header, name, "HostMpiDamStep", H5T_NATIVE_INT, steps);
    get_attribute(c, header, name, "HostMpiDamResolution", H5T_NATIVE_INT, &other);
    if (other != resolution) cloud_stop(c, name, "this file is of another -resolution");
    H5Gclose(header);
    group = file_need(c, H5Lexists(file, "PartType0", H5P_DEFAULT) > 0 ? H5Gopen2(file, "PartType0", H5P_DEFAULT) : -1, name, "this file has no particles");
    first = wanted * rank / ranks;
    n = wanted * (rank + 1) / ranks - first;
    c->n = 0;
    while (c->n < n) cloud_add(c, 0);
    for (set = 0; set < STORED; set++) {
        const hid_t data = file_need(c, H5Lexists(group, stored[set].name, H5P_DEFAULT) > 0 ? H5Dopen2(group, stored[set].name, H5P_DEFAULT) : -1, name, "an array is missing");
        const hid_t space = H5Dget_space(data);
        if (H5Sget_simple_extent_npoints(space) != wanted * stored[set].width) cloud_stop(c, name, "this file has another number of particles");
        transfer(c, data, together, name, set, 0, (hsize_t)first, (hsize_t)n);
        H5Sclose(space), H5Dclose(data);
    }
    H5Gclose(group), H5Fclose(file), H5Pclose(access), H5Pclose(together);
}
static void compare(cloud *c, const options *o, int64_t all)
{
    cloud other;
    double worst[3] = {0, 0, 0}; /* position, velocity, density */
    long long same = 0;
    int *const place = cloud_memory(c, NULL, (size_t)all, sizeof *place);
    int steps, i, k;
    memset(&other, 0, sizeof other);
    other.comm = c->comm, other.rank = c->rank, other.fields = MOVED;
    read_file(&other, MPI_COMM_SELF, o->compare, o->resolution, all, &steps);
    for (i = 0; i < other.n; i++) place[i] = -1;
    for (i = 0; i < other.n; i++)
        if (other.number[i] >= 0 && other.number[i] < all) place[other.number[i]] = i;
    for (i = 0; i < c->n; i++) {
        const int j = place[c->number[i]];
        int equal = 1;
        if (j < 0) cloud_stop(c, o->compare, "a particle is missing");
        for (k = X; k <= RHO; k++) {
            worst[k / 3] = fmax(worst[k / 3], fabs(c->f[k][i] - other.f[k][j]));
            equal &= !memcmp(&c->f[k][i], &other.f[k][j], sizeof(double));
        }
        same += equal;
    }
    MPI_Allreduce(MPI_IN_PLACE, worst, 3, MPI_DOUBLE, MPI_MAX, c->comm);
    MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_LONG_LONG, MPI_SUM, c->comm);
    if (c->rank == 0)
        printf("step %d of %s: position %.2e spacings, velocity %.2e, density %.2e; %lld of %lld particles have the same bits\n", steps,
               o->compare, worst[0] / spacing, worst[1], worst[2], same, (long long)all);
    for (k = 0; k < MOVED; k++) free(other.f[k]);
    free(other.number), free(other.weight), free(other.reach), free(other.start), free(place);
}

/* ---------------------------------------------------------------- the run */

static void say(cloud *c, int steps, double seconds, const int *rebuilt)
{
    const sph_list no_lists = {NULL, NULL};
    const sph_cloud own = sph_cloud_of(cloud_points(c, c->n), no_lists, sph_scalars_none(), sph_scalars_none()); /* copies may be on their way */
    sph_conserved sums;
    double sum[3], front = 0, imbalance;
    long long count[3] = {c->n_total - c->n, c->n == 0, c->inner};
    int i;
    cloud_need(c, sph_conserved_sums(3, own, sph_scalars_array(c->f[MASS]), sph_vectors_separate(c->f[VX], c->f[VY], c->f[VZ]), &sums),
               "sph_conserved_sums");
    sum[0] = sums.mass, sum[1] = sums.kinetic_energy, sum[2] = 0;
    for (i = 0; i < c->n; i++) {
        sum[2] += c->f[MASS][i] * gravity * c->f[Y][i];
        if (!(c->f[WALL][i] > 0)) front = fmax(front, c->f[X][i]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, c->comm);
    MPI_Allreduce(MPI_IN_PLACE, &front, 1, MPI_DOUBLE, MPI_MAX, c->comm);
    MPI_Allreduce(MPI_IN_PLACE, count, 3, MPI_LONG_LONG, MPI_SUM, c->comm);
    imbalance = cloud_imbalance(c);
    if (c->rank == 0) {
        printf("step %d time %.4f front %.6f mass %.12g kinetic %.8g potential %.8g copies %lld empty %lld inner %lld imbalance %.3f rebuilt %d balanced %d %.1f s\n",
               steps, steps * dt, front, sum[0], sum[1], sum[2], count[0], count[1], count[2], imbalance, rebuilt[0], rebuilt[1], seconds);
        fflush(stdout);
    }
}
static const char *whole(const char *text, int least, int *value)
{
    char *end;
    const long v = strtol(text, &end, 10);
    if (end == text || *end || v < least || v > 1000000000) return text;
    *value = (int)v;
    return NULL;
}
/* Returns what is wrong, or null. */
static const char *read_options(int argc, char **argv, options *o)
{
    int i;
    for (i = 1; i < argc; i++) {
        const char *const name = argv[i], *const value = i + 1 < argc ? argv[i + 1] : "", *wrong = NULL;
        if (!strcmp(name, "-sorted")) { o->sorted = 1; continue; }
        if (!strcmp(name, "-keep")) { o->keep = 1; continue; }
        if (!strcmp(name, "-resolution")) wrong = whole(value, 2, &o->resolution);
        else if (!strcmp(name, "-steps")) wrong = whole(value, 0, &o->steps);
        else if (!strcmp(name, "-every")) wrong = whole(value, 1, &o->every);
        else if (!strcmp(name, "-progress")) wrong = whole(value, 1, &o->progress);
        else if (!strcmp(name, "-parts")) wrong = whole(value, 1, &o->parts);
        else if (!strcmp(name, "-break")) wrong = whole(value, 0, &o->stop_at);
        else if (!strcmp(name, "-halo")) wrong = (o->halo = atof(value)) > 0 ? NULL : value;
        else if (!strcmp(name, "-write")) wrong = strlen(o->write = value) < 1000 ? NULL : value;
        else if (!strcmp(name, "-restart")) o->restart = value;
        else if (!strcmp(name, "-compare")) o->compare = value;
        else return name;
        if (wrong || !*value) return name;
        i++;
    }
    return NULL;
}
int main(int argc, char **argv)
{
    options o = {.resolution = 12, .steps = 500, .progress = 100, .stop_at = -1, .halo = 1};
    int steps = 0, first, rebuilt[2] = {0, 0};
    const char *wrong;
    double begin;
    int64_t all;
    long long sent[2];
    cloud c;
    MPI_Init(&argc, &argv);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* what went wrong is said here */
    wrong = read_options(argc, argv, &o);
    cloud_begin(&c, MPI_COMM_WORLD, o.parts, MOVED, FIELDS);
    if (wrong) { /* all ranks see the same */
        if (c.rank == 0) fprintf(stderr, "host_mpi_dam: option %s: unknown, or without a value that is possible\n", wrong);
        cloud_end(&c);
        MPI_Finalize();
        return 2;
    }
    spacing = 1.0 / o.resolution;
    h = 1.3 * spacing;
    dt = 0.2 * h / water.c;
    all = fill(&c, o.resolution);
    if (o.restart) read_file(&c, c.comm, o.restart, o.resolution, all, &steps);
    find_neighbours(&c, &o, 1);
    find_neighbours(&c, &o, 1); /* now that the lists tell the work */
    begin = MPI_Wtime();
    c.seconds = 0;
    first = steps; /* there is a file of it */
    for (; steps < o.steps; steps++) {
        int again;
        char name[1040];
        if (steps % o.progress == 0) say(&c, steps, MPI_Wtime() - begin, rebuilt);
        if (o.write && o.every && steps > 0 && steps % o.every == 0 && steps != first) {
            snprintf(name, sizeof name, o.keep ? "%s_%09d" : "%s", o.write, steps);
            write_file(&c, &o, name, steps);
            find_neighbours(&c, &o, 0); /* as a restart does: rows with other pairs beyond h's support round otherwise */
        }
        again = step(&c, &o);
        rebuilt[0] += again > 0;
        rebuilt[1] += again > 1;
    }
    say(&c, steps, MPI_Wtime() - begin, rebuilt);
    cloud_say_seconds(&c, "sweeps and lists", steps - first);
    if (o.write) write_file(&c, &o, o.write, steps);
    if (o.compare) compare(&c, &o, all);
    sent[0] = c.values, sent[1] = c.left;
    MPI_Allreduce(MPI_IN_PLACE, sent, 2, MPI_LONG_LONG, MPI_SUM, c.comm);
    if (c.rank == 0) printf("values %lld of copies in %lld exchanges; %lld particles went to another rank\n", sent[0], (long long)c.exchanges, sent[1]);
    cloud_end(&c);
    MPI_Finalize();
    return 0;
}
