/* SPDX-License-Identifier: MIT
 *
 * host_mpi_poisson.c - Poisson's equation on scattered points, on many ranks: rows by sph.h, a solver by PETSc.
 *
 *     mpicc -O2 -I. -I/usr/include/trilinos examples/hosts/host_mpi_poisson.c -o host_mpi_poisson \
 *         $(pkg-config --cflags --libs PETSc) -ltrilinos_zoltan -lm
 *     mpirun -n 4 ./host_mpi_poisson -side 40 [-jump 1000] [-parts 3] [-write FILE] [-compare FILE]
 *
 * div(m grad u) = f in the unit cube, u given on its surface: m = 1, u = cos(pi x) cos(2 pi y) cos(pi z), or with
 * -jump blocks of m = 1 and m = 1 / jump. Options of PETSc's (-ksp_type, -pc_type, -ksp_monitor, ...) apply;
 * without any it is GMRES with hypre's BoomerAMG on the right: on the left its residual would be that of the
 * preconditioned system, which may be a hundred times smaller than the true one. -write stores the solution in
 * the order of the points' numbers, and -compare prints the largest difference from such a file.
 *
 * The rows of sph.h with the diagonal behind them are the array of values that MatSetValuesCOO takes: where each
 * goes is said once, and new values later are one call. Numbers here are local, own | halo; PETSc has a map.
 */
#include "host_mpi.h"
#include <petscksp.h>

enum { X, Y, Z, MOBILITY, EDGE, RIGHT, FIELDS };
#define KERNEL SPH_WENDLAND_C2
static const double pi = 3.14159265358979324;

static double uniform(uint64_t a) /* in 0 ... 1, by the number alone: the same on any rank */
{
    a *= UINT64_C(0x9e3779b97f4a7c15);
    a = (a ^ a >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    a = (a ^ a >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)((a ^ a >> 31) >> 11) / 9007199254740992.0;
}
static double exact(double x, double y, double z) { return cos(pi * x) * cos(2 * pi * y) * cos(pi * z); }

/* each rank its share of the numbers: points of a lattice, those inside moved by up to a fifth of the spacing */
static void fill(cloud *c, int side, double jump)
{
    const int64_t n = (int64_t)side * side * side;
    int64_t id;
    for (id = n * c->rank / c->ranks; id < n * (c->rank + 1) / c->ranks; id++) {
        const int at[3] = {(int)(id % side), (int)(id / side % side), (int)(id / side / side)}, i = cloud_add(c, id);
        const uint64_t block = ((uint64_t)(at[0] / 6) << 40) + ((uint64_t)(at[1] / 6) << 20) + (uint64_t)(at[2] / 6) + 1;
        double u;
        int k, edge = 0;
        for (k = 0; k < 3; k++) edge |= at[k] == 0 || at[k] == side - 1;
        for (k = 0; k < 3; k++)
            c->f[k][i] = (at[k] + (edge ? 0 : 0.4 * (uniform((uint64_t)(3 * id + k + 1)) - 0.5))) / (side - 1);
        u = exact(c->f[X][i], c->f[Y][i], c->f[Z][i]);
        c->f[MOBILITY][i] = jump > 1 && uniform(block) < 0.3 ? 1 / jump : 1;
        c->f[EDGE][i] = edge;
        c->f[RIGHT][i] = edge ? u : -6 * pi * pi * u;
    }
}

/* the number of each own particle and of the halo in PETSc's order: rank by rank */
static PetscInt *global_numbers(cloud *c)
{
    int64_t *const number = cloud_memory(c, NULL, (size_t)c->n_total, sizeof *number);
    PetscInt *const global = cloud_memory(c, NULL, (size_t)c->n_total, sizeof *global);
    long long first = 0, count = c->n;
    int i;
    MPI_Exscan(&count, &first, 1, MPI_LONG_LONG, MPI_SUM, c->comm);
    if (c->rank == 0) first = 0;
    for (i = 0; i < c->n; i++) number[i] = first + i;
    cloud_exchange_numbers(c, number);
    for (i = 0; i < c->n_total; i++) global[i] = (PetscInt)number[i];
    free(number);
    return global;
}
/* values: the rows of the lists, and behind them n diagonals */
static PetscErrorCode assemble(cloud *c, const double *values, Mat *A, Vec *b)
{
    const PetscCount entries = (PetscCount)c->pairs + c->n;
    PetscInt *const global = global_numbers(c), *row, *column;
    PetscScalar *right;
    ISLocalToGlobalMapping map;
    sph_index p;
    int i;
    PetscFunctionBeginUser;
    PetscCall(PetscMalloc2(entries, &row, entries, &column));
    for (i = 0; i < c->n; i++) {
        for (p = c->start[i]; p < c->start[i + 1]; p++) {
            row[p] = i;
            column[p] = c->index[p];
        }
        row[c->pairs + i] = column[c->pairs + i] = i;
    }
    PetscCall(ISLocalToGlobalMappingCreate(c->comm, 1, c->n_total, global, PETSC_COPY_VALUES, &map));
    PetscCall(MatCreate(c->comm, A));
    PetscCall(MatSetSizes(*A, c->n, c->n, PETSC_DETERMINE, PETSC_DETERMINE));
    PetscCall(MatSetFromOptions(*A));
    PetscCall(MatSetLocalToGlobalMapping(*A, map, map));
    PetscCall(MatSetPreallocationCOOLocal(*A, entries, row, column));
    PetscCall(MatSetValuesCOO(*A, values, INSERT_VALUES));
    PetscCall(MatCreateVecs(*A, NULL, b));
    PetscCall(VecGetArrayWrite(*b, &right));
    memcpy(right, c->f[RIGHT], (size_t)c->n * sizeof *right);
    PetscCall(VecRestoreArrayWrite(*b, &right));
    PetscCall(ISLocalToGlobalMappingDestroy(&map));
    PetscCall(PetscFree2(row, column));
    free(global);
    PetscFunctionReturn(0);
}
static PetscErrorCode solve(cloud *c, Mat A, Vec b, Vec u, PetscInt *iterations, PetscReal *residual)
{
    static const char threshold[] = "-pc_hypre_boomeramg_strong_threshold";
    PetscBool given;
    KSP solver;
    PC preconditioner;
    KSPConvergedReason reason;
    PetscReal size;
    Vec r;
    PetscFunctionBeginUser;
    PetscCall(KSPCreate(c->comm, &solver));
    PetscCall(KSPSetOperators(solver, A, A));
    PetscCall(KSPSetType(solver, KSPGMRES));
    PetscCall(KSPGMRESSetRestart(solver, 100));
    PetscCall(KSPSetPCSide(solver, PC_RIGHT));
    PetscCall(KSPSetTolerances(solver, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 2000));
    PetscCall(KSPGetPC(solver, &preconditioner));
#ifdef PETSC_HAVE_HYPRE
    PetscCall(PCSetType(preconditioner, PCHYPRE));
    PetscCall(PCHYPRESetType(preconditioner, "boomeramg"));
    PetscCall(PetscOptionsHasName(NULL, NULL, threshold, &given));
    if (!given) PetscCall(PetscOptionsSetValue(NULL, threshold, "0.5")); /* of 3D; hypre's own is that of 2D */
#else
    PetscCall(PCSetType(preconditioner, PCGAMG));
#endif
    PetscCall(KSPSetFromOptions(solver));
    PetscCall(KSPSolve(solver, b, u));
    PetscCall(KSPGetConvergedReason(solver, &reason));
    if (reason < 0) cloud_stop(c, "KSPSolve", KSPConvergedReasons[reason]);
    PetscCall(KSPGetIterationNumber(solver, iterations));
    PetscCall(VecDuplicate(b, &r));
    PetscCall(MatMult(A, u, r));
    PetscCall(VecAYPX(r, -1, b));
    PetscCall(VecNorm(r, NORM_2, residual));
    PetscCall(VecNorm(b, NORM_2, &size));
    *residual /= size;
    PetscCall(VecDestroy(&r));
    PetscCall(KSPDestroy(&solver));
    PetscFunctionReturn(0);
}
/* u in the order of the points' numbers, which is the same on any number of ranks */
static PetscErrorCode in_order(cloud *c, Vec u, Vec *sorted)
{
    PetscInt *place, all;
    IS to;
    VecScatter scatter;
    int i;
    PetscFunctionBeginUser;
    PetscCall(VecGetSize(u, &all));
    PetscCall(PetscMalloc1(c->n, &place));
    for (i = 0; i < c->n; i++) place[i] = (PetscInt)c->number[i];
    PetscCall(ISCreateGeneral(c->comm, c->n, place, PETSC_OWN_POINTER, &to));
    PetscCall(VecCreateMPI(c->comm, PETSC_DECIDE, all, sorted));
    PetscCall(VecScatterCreate(u, NULL, *sorted, to, &scatter));
    PetscCall(VecScatterBegin(scatter, u, *sorted, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecScatterEnd(scatter, u, *sorted, INSERT_VALUES, SCATTER_FORWARD));
    PetscCall(VecScatterDestroy(&scatter));
    PetscCall(ISDestroy(&to));
    PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
    static const double one = 1, zero = 0;
    static const int sent[] = {X, Y, Z, MOBILITY};
    char write[1024], compare[1024];
    PetscInt side = 32, parts = 0, iterations;
    PetscReal jump = 1, residual;
    PetscBool writes, compares;
    double h, volume, radius, most = 0;
    long long copies, pairs;
    const PetscScalar *value;
    cloud c;
    Mat A;
    Vec b, u, sorted;
    int i;
    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-side", &side, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-parts", &parts, NULL));
    PetscCall(PetscOptionsGetReal(NULL, NULL, "-jump", &jump, NULL));
    PetscCall(PetscOptionsGetString(NULL, NULL, "-write", write, sizeof write, &writes));
    PetscCall(PetscOptionsGetString(NULL, NULL, "-compare", compare, sizeof compare, &compares));
    cloud_begin(&c, PETSC_COMM_WORLD, (int)parts, FIELDS, FIELDS);
    if (side < 4 || side > 1000) cloud_stop(&c, "-side", "4 ... 1000 points along the cube's edges are possible");
    fill(&c, (int)side, jump);
    h = 1.3 / (side - 1);
    volume = 1.0 / ((double)(side - 1) * (side - 1) * (side - 1));
    radius = sph_kernel_support_ratio(KERNEL) * h;
    cloud_balance(&c);
    cloud_halo(&c, sph_scalars_same(&radius), SPH_GATHER);
    cloud_exchange(&c, 4, sent);
    cloud_exchange_numbers(&c, c.number);
    cloud_clock(&c, -1);
    cloud_lists(&c, sph_scalars_same(&radius), SPH_GATHER, CLOUD_ORDERED);
    copies = c.n_total - c.n;
    pairs = c.pairs;
    { /* the part that knows of SPH */
        const sph_cloud view = cloud_view(&c, sph_scalars_same(&h), sph_scalars_same(&volume));
        const sph_scalars mobility = sph_scalars_array(c.f[MOBILITY]), none = sph_scalars_same(&zero);
        const sph_boundary given = {.normal = {none, none, none}, .alpha = sph_scalars_array(c.f[EDGE]), .beta = none};
        double *const row = cloud_memory(&c, NULL, (size_t)(c.pairs + c.n), sizeof *row);
        unsigned char *const status = cloud_memory(&c, NULL, (size_t)c.n, 1);
        const sph_rows_out out = {.row = row, .diagonal = row + c.pairs, .status = status};
        const sph_elliptic_options options = {.trace = 1, .mean = jump > 1 ? (int)SPH_MOBILITY_HARMONIC : (int)SPH_MOBILITY_ARITHMETIC};
        const sph_index answer = sph_elliptic_rows_msph(KERNEL, 3, view, mobility, options, out);
        if (answer < 0) cloud_need(&c, answer, "sph_elliptic_rows_msph");
        for (i = 0; i < c.n; i++) /* rows of the surface are written over */
            if (!(c.f[EDGE][i] > 0)) cloud_need(&c, status[i], "sph_elliptic_rows_msph");
        cloud_need(&c, sph_elliptic_rows_boundary(KERNEL, 3, view, sph_scalars_same(&one), options, given, out), "sph_elliptic_rows_boundary");
        cloud_clock(&c, 1);
        PetscCall(assemble(&c, row, &A, &b));
        free(row), free(status);
    }
    PetscCall(VecDuplicate(b, &u));
    PetscCall(solve(&c, A, b, u, &iterations, &residual));
    PetscCall(VecGetArrayRead(u, &value));
    for (i = 0; i < c.n && jump <= 1; i++) most = fmax(most, fabs(value[i] - exact(c.f[X][i], c.f[Y][i], c.f[Z][i])));
    PetscCall(VecRestoreArrayRead(u, &value));
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, c.comm);
    MPI_Allreduce(MPI_IN_PLACE, &copies, 1, MPI_LONG_LONG, MPI_SUM, c.comm);
    MPI_Allreduce(MPI_IN_PLACE, &pairs, 1, MPI_LONG_LONG, MPI_SUM, c.comm);
    PetscCall(PetscPrintf(c.comm, "ranks %d points %lld pairs %lld copies %lld residual %.2e iterations %d error %.4e\n", c.ranks,
                          (long long)side * side * side, pairs, copies, (double)residual, (int)iterations, most));
    cloud_say_seconds(&c, "lists and rows", 1);
    PetscCall(in_order(&c, u, &sorted));
    if (writes) {
        PetscViewer file;
        PetscCall(PetscViewerBinaryOpen(c.comm, write, FILE_MODE_WRITE, &file));
        PetscCall(VecView(sorted, file));
        PetscCall(PetscViewerDestroy(&file));
    }
    if (compares) {
        PetscViewer file;
        PetscReal difference, size;
        Vec other;
        PetscCall(VecDuplicate(sorted, &other));
        PetscCall(PetscViewerBinaryOpen(c.comm, compare, FILE_MODE_READ, &file));
        PetscCall(VecLoad(other, file));
        PetscCall(PetscViewerDestroy(&file));
        PetscCall(VecNorm(other, NORM_INFINITY, &size));
        PetscCall(VecAXPY(other, -1, sorted));
        PetscCall(VecNorm(other, NORM_INFINITY, &difference));
        PetscCall(PetscPrintf(c.comm, "difference %.3e of %.3e\n", (double)difference, (double)size));
        PetscCall(VecDestroy(&other));
    }
    PetscCall(VecDestroy(&sorted));
    PetscCall(VecDestroy(&u));
    PetscCall(VecDestroy(&b));
    PetscCall(MatDestroy(&A));
    cloud_end(&c);
    PetscCall(PetscFinalize());
    return 0;
}
