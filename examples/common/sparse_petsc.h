/* SPDX-License-Identifier: MIT */
/*
 * sparse_petsc.h - the system of sparse.h solved by PETSc, where that is installed: GMRES with algebraic multigrid, hypre's BoomerAMG if PETSc was built with
 * it, else PETSc's own GAMG.
 *
 *     cc -DHAVE_PETSC=1 ... $(pkg-config --cflags --libs PETSc mpi)
 *     PetscInitialize(&argc, &argv, NULL, NULL);
 *     if (sparse_petsc_helped()) ...                             all ranks but the first end here: they have solved with it
 *     result = sparse_petsc(&A, NULL, b, x, &o);
 *     sparse_petsc_done();
 *     PetscFinalize();
 *
 * By mpirun the matrix, which only the first rank has, is shared by all ranks. Without HAVE_PETSC this file is empty. Options of PETSc's command line (-ksp_view,
 * -pc_type, ...) apply.
 */
#ifndef SPARSE_PETSC_H
#define SPARSE_PETSC_H
#ifndef HAVE_PETSC
#define HAVE_PETSC 0
#endif
#if HAVE_PETSC

/* names that options.h has, too */
#define OPTION_INT sparse_petsc_int
#define OPTION_REAL sparse_petsc_real
#include <petscksp.h>
#undef OPTION_INT
#undef OPTION_REAL

#include "sparse.h"

/* What all ranks are told of a system. n < 0: there is none any more. */
typedef struct sparse_petsc_task {
    int n, restart, max_iterations;
    double tolerance;
} sparse_petsc_task;

/* PETSc's matrix with a copy of the entries, of which the first rank has all, and the others (A is null) none: PETSc brings each to where its row lives. */
static inline PetscErrorCode sparse_petsc_matrix(const sparse *A, int n, Mat *M)
{
    const int64_t count = A ? A->start[n] : 0;
    PetscInt *const row = (PetscInt *)sparse_memory(count, sizeof *row), *const column = (PetscInt *)sparse_memory(count, sizeof *column);
    PetscErrorCode error = row && column ? MatCreate(PETSC_COMM_WORLD, M) : PETSC_ERR_MEM;
    for (int i = 0; A && !error && i < n; ++i)
        for (int64_t k = A->start[i]; k < A->start[i + 1]; ++k) {
            row[k] = i;
            column[k] = A->index[k];
        }
    if (!error) error = MatSetSizes(*M, PETSC_DECIDE, PETSC_DECIDE, n, n);
    if (!error) error = MatSetType(*M, MATAIJ);
    if (!error) error = MatSetPreallocationCOO(*M, (PetscCount)count, row, column);
    if (!error) error = MatSetValuesCOO(*M, A ? A->value : NULL, INSERT_VALUES);
    free(row);
    free(column);
    return error;
}

/* Called by PETSc after each iteration. */
static inline PetscErrorCode sparse_petsc_see(KSP solver, PetscInt iteration, PetscReal norm, void *context)
{
    const sparse_options *o = (const sparse_options *)((void **)context)[0];
    const double *b_norm = (const double *)((void **)context)[1];
    (void)solver;
    if (iteration <= o->max_iterations) sparse_record(o, (int)iteration, (double)norm / *b_norm);
    return 0;
}

/* All ranks together. b, x and see, the context of sparse_petsc_see, are those of the first rank, and null on the others. */
static inline PetscErrorCode sparse_petsc_solve(sparse_petsc_task task, const sparse *A, const double *b, double *x, void *see, PetscInt *iterations)
{
    Mat M = NULL;
    Vec rhs = NULL, u = NULL, whole = NULL;
    VecScatter to_first = NULL;
    KSP solver = NULL;
    PC pc = NULL;
    PetscErrorCode error = sparse_petsc_matrix(A, task.n, &M);
    if (!error) error = MatCreateVecs(M, &u, &rhs);
    if (!error) error = VecScatterCreateToZero(u, &to_first, &whole);
    for (int k = 0; k < 2 && !error; ++k) { /* b and the first guess to where their rows are */
        if (b) error = VecPlaceArray(whole, k ? x : b);
        if (!error) error = VecScatterBegin(to_first, whole, k ? u : rhs, INSERT_VALUES, SCATTER_REVERSE);
        if (!error) error = VecScatterEnd(to_first, whole, k ? u : rhs, INSERT_VALUES, SCATTER_REVERSE);
        if (b && !error) error = VecResetArray(whole);
    }
    if (!error) error = KSPCreate(PETSC_COMM_WORLD, &solver);
    if (!error) error = KSPSetOperators(solver, M, M);
    if (!error) error = KSPSetType(solver, KSPGMRES);
    if (!error) error = KSPGMRESSetRestart(solver, task.restart > 0 ? task.restart : task.max_iterations > 0 ? task.max_iterations : 1);
    if (!error) error = KSPSetPCSide(solver, PC_RIGHT); /* so that its residual is the true one */
    if (!error) error = KSPSetInitialGuessNonzero(solver, PETSC_TRUE);
    if (!error) error = KSPSetTolerances(solver, task.tolerance, 1e-300, 1e300, task.max_iterations);
    if (!error && see) error = KSPMonitorSet(solver, sparse_petsc_see, see, NULL);
    if (!error) error = KSPGetPC(solver, &pc);
#ifdef PETSC_HAVE_HYPRE
    if (!error) error = PCSetType(pc, PCHYPRE);
    if (!error) error = PCHYPRESetType(pc, "boomeramg");
#else
    if (!error) error = PCSetType(pc, PCGAMG);
#endif
    if (!error) error = KSPSetFromOptions(solver);
    if (!error) error = KSPSolve(solver, rhs, u);
    if (!error) error = KSPGetIterationNumber(solver, iterations);
    if (x && !error) error = VecPlaceArray(whole, x);
    if (!error) error = VecScatterBegin(to_first, u, whole, INSERT_VALUES, SCATTER_FORWARD);
    if (!error) error = VecScatterEnd(to_first, u, whole, INSERT_VALUES, SCATTER_FORWARD);
    if (x && !error) error = VecResetArray(whole);
    KSPDestroy(&solver);
    VecScatterDestroy(&to_first);
    VecDestroy(&whole);
    VecDestroy(&u);
    VecDestroy(&rhs);
    MatDestroy(&M);
    return error;
}
static inline void sparse_petsc_tell(sparse_petsc_task *task) { MPI_Bcast(task, (int)sizeof *task, MPI_BYTE, 0, PETSC_COMM_WORLD); }

/* On the first rank 0, at once. The others solve with it whatever it solves, until it calls sparse_petsc_done, and then it is 1. */
static inline int sparse_petsc_helped(void)
{
    sparse_petsc_task task;
    PetscInt iterations;
    int rank;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    if (rank == 0) return 0;
    for (sparse_petsc_tell(&task); task.n >= 0; sparse_petsc_tell(&task))
        if (sparse_petsc_solve(task, NULL, NULL, NULL, NULL, &iterations)) MPI_Abort(PETSC_COMM_WORLD, 1); /* or the first would wait */
    return 1;
}
static inline void sparse_petsc_done(void)
{
    sparse_petsc_task none = {-1, 0, 0, 0.0};
    sparse_petsc_tell(&none);
}

/* As sparse_gmres; the preconditioner of sparse.h is not used, and P may be NULL. PETSc's tolerance is the one of the options, and what is returned is verified
 * as by the other solvers. */
static inline sparse_result sparse_petsc(const sparse *A, const sparse_preconditioner *P, const double *b, double *x, const sparse_options *options)
{
    const sparse_options o = *options;
    sparse_result result;
    double b_norm, *r = NULL;
    PetscInt iterations = 0;
    (void)P;
    if (!sparse_solve_begin(A, b, x, &o, &result, &b_norm)) return result;
    void *see[2];
    see[0] = (void *)(uintptr_t)&o;
    see[1] = &b_norm;

    if ((r = sparse_vector(A->n)) != NULL) {
        sparse_petsc_task task = {A->n, o.restart, o.max_iterations, o.tolerance};
        sparse_petsc_tell(&task);
        const PetscErrorCode error = sparse_petsc_solve(task, A, b, x, see, &iterations);
        result.iterations = (int)iterations;
        result.status = error ? SPARSE_FAILED : iterations < o.max_iterations ? SPARSE_STAGNATED : SPARSE_TOO_FEW_ITERATIONS;
        sparse_solve_end(A, b, x, r, &o, b_norm, &result); /* says SPARSE_CONVERGED if it is */
    } else {
        memset(x, 0, (size_t)A->n * sizeof *x);
        result.status = SPARSE_NO_MEMORY;
    }
    free(r);
    return result;
}

#endif
#endif
