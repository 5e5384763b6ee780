/* SPDX-License-Identifier: MIT */
/*
 * sparse_petsc.h - the system of sparse.h solved by PETSc, where that is installed: GMRES with algebraic multigrid, hypre's BoomerAMG if PETSc was built with
 * it, else PETSc's own GAMG.
 *
 *     cc -DHAVE_PETSC=1 ... $(pkg-config --cflags --libs PETSc mpi)
 *     PetscInitialize(&argc, &argv, NULL, NULL);
 *     result = sparse_petsc(&A, NULL, b, x, &o);
 *     PetscFinalize();
 *
 * One process. Without HAVE_PETSC this file is empty. Options of PETSc's command line (-ksp_view, -pc_type, ...) apply.
 */
#ifndef SPARSE_PETSC_H
#define SPARSE_PETSC_H
#ifndef HAVE_PETSC
#define HAVE_PETSC 0
#endif
#if HAVE_PETSC

#include <petscksp.h>

#include "sparse.h"

/* PETSc's matrix with a copy of the entries: its integers may be wider or narrower. Rows are preallocated, so that nothing moves. */
static inline PetscErrorCode sparse_petsc_matrix(const sparse *A, Mat *M)
{
    PetscInt *length = (PetscInt *)sparse_memory(A->n, sizeof *length);
    if (!length) return PETSC_ERR_MEM;
    for (int i = 0; i < A->n; ++i) length[i] = (PetscInt)(A->start[i + 1] - A->start[i]);
    PetscErrorCode error = MatCreateSeqAIJ(PETSC_COMM_SELF, A->n, A->n, 0, length, M);
    free(length);
    for (int i = 0; i < A->n && !error; ++i)
        for (int64_t k = A->start[i]; k < A->start[i + 1] && !error; ++k) error = MatSetValue(*M, i, A->index[k], A->value[k], INSERT_VALUES);
    if (!error) error = MatAssemblyBegin(*M, MAT_FINAL_ASSEMBLY);
    if (!error) error = MatAssemblyEnd(*M, MAT_FINAL_ASSEMBLY);
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

/* As sparse_gmres; the preconditioner of sparse.h is not used, and P may be NULL. PETSc's tolerance is the one of the options, and what is returned is verified
 * as by the other solvers. */
static inline sparse_result sparse_petsc(const sparse *A, const sparse_preconditioner *P, const double *b, double *x, const sparse_options *options)
{
    const sparse_options o = *options;
    sparse_result result;
    double b_norm, *r = NULL;
    Mat M = NULL;
    Vec rhs = NULL, u = NULL;
    KSP solver = NULL;
    PC pc = NULL;
    PetscInt iterations = 0;
    (void)P;
    if (!sparse_solve_begin(A, b, x, &o, &result, &b_norm)) return result;
    void *context[2];
    context[0] = (void *)(uintptr_t)&o;
    context[1] = &b_norm;

    PetscErrorCode error = (r = sparse_vector(A->n)) == NULL ? PETSC_ERR_MEM : sparse_petsc_matrix(A, &M);
    if (!error) error = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, A->n, b, &rhs);
    if (!error) error = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, A->n, x, &u);
    if (!error) error = KSPCreate(PETSC_COMM_SELF, &solver);
    if (!error) error = KSPSetOperators(solver, M, M);
    if (!error) error = KSPSetType(solver, KSPGMRES);
    if (!error) error = KSPGMRESSetRestart(solver, o.restart > 0 ? o.restart : o.max_iterations > 0 ? o.max_iterations : 1);
    if (!error) error = KSPSetPCSide(solver, PC_RIGHT); /* so that its residual is the true one */
    if (!error) error = KSPSetInitialGuessNonzero(solver, PETSC_TRUE);
    if (!error) error = KSPSetTolerances(solver, o.tolerance, 1e-300, 1e300, o.max_iterations);
    if (!error) error = KSPMonitorSet(solver, sparse_petsc_see, context, NULL);
    if (!error) error = KSPGetPC(solver, &pc);
#ifdef PETSC_HAVE_HYPRE
    if (!error) error = PCSetType(pc, PCHYPRE);
    if (!error) error = PCHYPRESetType(pc, "boomeramg");
#else
    if (!error) error = PCSetType(pc, PCGAMG);
#endif
    if (!error) error = KSPSetFromOptions(solver);
    if (!error) error = KSPSolve(solver, rhs, u);
    if (!error) error = KSPGetIterationNumber(solver, &iterations);
    KSPDestroy(&solver);
    VecDestroy(&u);
    VecDestroy(&rhs);
    MatDestroy(&M);

    if (r) {
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
