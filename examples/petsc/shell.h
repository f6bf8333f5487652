/* SPDX-License-Identifier: MIT */
/* shell.h - what the examples with PETSc share: plates on as many processes as there are, K as a MATSHELL, and a conjugate-gradient solver.

   K is never stored: a MATSHELL asks peri_multiply_stiffness for the rows that a process owns. What preconditions it is the algebraic
   multigrid of PETSc on the matrix of a proxy: the same points with bonds to their nearest neighbours alone (bond-based, horizon 1.5
   spacings: 18 entries a row), cut and broken as those of the plate. */
#ifndef SHELL_H
#define SHELL_H

#include <petscksp.h>

#include "../mpi/parts.h"

#define H        (1.0 / 1024) /* [m] spacing */
#define YOUNG    200e9        /* [Pa] */
#define ACCURACY 1e-11        /* of the residual, over the load */

typedef struct plate { /* what a process has of it */
    part       p;
    peri_body *body;
    PetscInt   own;             /* points */
    PetscInt  *number;          /* of each cell, as PETSc counts: by processes */
    double    *held, *in, *out; /* [2 points] */
    Mat        k, proxy;
    Vec        u, force;
    KSP        solver;
} plate;

static inline peri_body *start_body(int32_t law, double horizon, double critical_stretch) {
    peri_body *b = NULL;
    peri_body_desc desc;
    peri_material_desc steel;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.geometry = PERI_GEOMETRY_LINEAR, desc.horizon = horizon, desc.threads = 1;
    must(b, peri_body_create(&desc, &b, NULL));
    peri_material_desc_init(&steel, law);
    steel.young = YOUNG, steel.density = 7800; /* [kg/m^3] */
    if (law == PERI_LAW_LPS) steel.poisson = 0.3;
    if (critical_stretch > 0) steel.critical_stretch = critical_stretch;
    must(b, peri_add_material(b, &steel));
    return b;
}

/* nx by ny cells: the part of this process, or all where p is NULL. */
static inline peri_body *start_plate(part *p, int64_t nx, int64_t ny, double critical_stretch) {
    const double lo[2] = {0, 0}, hi[2] = {(double)nx * H, (double)ny * H};
    const int64_t counts[2] = {nx, ny};
    peri_body *b = start_body(PERI_LAW_LPS, 3.015 * H, critical_stretch);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    if (p) {
        part_of_box(p, 2, counts, peri_ghost_depth(b) * 4);
        must(b, peri_add_shape(b, material, lo, hi, H, part_takes, p));
        part_set(p, b, lo, H, H * H);
    } else
        must(b, peri_add_box(b, material, lo, hi, H));
    must(b, peri_build(b));
    return b;
}

static inline int32_t is_broken(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    return (void)xi, (void)xj, peri_bond_is_intact((peri_body *)user, i, j) == 0;
}

/* The proxy is no part, but its rows are whole where the neighbours are there as ghosts. Points that have lost most of its bonds, which are
   fewer than those of the plate, lean on the ground. */
static inline Mat make_proxy(const plate *t) {
    const int64_t n = t->p.points;
    double *x = (double *)room(2 * n, sizeof *x), *volume = (double *)room(n, sizeof *volume), *damage = (double *)room(n, sizeof *damage);
    peri_body *b = start_body(PERI_LAW_BOND_BASED, 1.5 * H, 0);
    peri_matrix *matrix = NULL;
    Mat a;
    must(t->body, peri_get_field(t->body, PERI_FIELD_POSITION, x, 2 * n));
    must(t->body, peri_get_field(t->body, PERI_FIELD_VOLUME, volume, n));
    must(b, peri_add_points(b, n, x, volume, NULL));
    must(b, peri_build(b));
    must(b, peri_cut_if(b, PERI_CUT_INITIAL, is_broken, t->body));
    must(b, peri_get_field(b, PERI_FIELD_DAMAGE, damage, n));
    must(b, peri_matrix_create(b, &matrix));
    const int64_t entries = peri_matrix_entries(matrix);
    int64_t *start = (int64_t *)room(2 * n + 1, sizeof *start);
    int32_t *column = (int32_t *)room(entries, sizeof *column);
    double *value = (double *)room(entries, sizeof *value);
    must(b, peri_get_matrix(matrix, start, column, value));
    MatCreate(PETSC_COMM_WORLD, &a), MatSetSizes(a, 2 * t->own, 2 * t->own, PETSC_DETERMINE, PETSC_DETERMINE);
    MatSetType(a, MATAIJ), MatSetBlockSize(a, 2);
    MatSeqAIJSetPreallocation(a, 18, NULL), MatMPIAIJSetPreallocation(a, 18, NULL, 18, NULL);
    for (int64_t row = 0; row < 2 * n; ++row)
        for (int64_t k = start[row]; k < start[row + 1] && t->p.mine[t->p.ids[row / 2]] == 1; ++k) {
            const int32_t c = column[k];
            const int stays = row == c || (t->held[row] == 0 && t->held[c] == 0);
            const double ground = row == c && damage[row / 2] > 0.65 ? YOUNG : 0;
            MatSetValue(a, 2 * t->number[t->p.ids[row / 2]] + (PetscInt)(row % 2), 2 * t->number[t->p.ids[c / 2]] + c % 2,
                        stays ? value[k] + ground : 0, INSERT_VALUES);
        }
    MatAssemblyBegin(a, MAT_FINAL_ASSEMBLY), MatAssemblyEnd(a, MAT_FINAL_ASSEMBLY);
    free(x), free(volume), free(damage), free(start), free(column), free(value);
    peri_matrix_destroy(matrix), peri_body_destroy(b);
    return a;
}

/* Own points of a vector of PETSc to the part, 0 where supports hold. */
static inline void take(const plate *t, Vec vector, double *points) {
    const PetscScalar *own;
    VecGetArrayRead(vector, &own);
    for (int64_t i = 0, k = 0; i < 2 * t->p.points; ++i)
        if (t->p.mine[t->p.ids[i / 2]] == 1) points[i] = t->held[i] != 0 ? 0 : own[k], ++k;
    VecRestoreArrayRead(vector, &own);
}

/* And back; where supports hold those of `held`, times E, or 0. */
static inline void give(const plate *t, const double *points, Vec vector, Vec held) {
    const PetscScalar *same = NULL;
    PetscScalar *own;
    if (held) VecGetArrayRead(held, &same);
    VecGetArray(vector, &own);
    for (int64_t i = 0, k = 0; i < 2 * t->p.points; ++i)
        if (t->p.mine[t->p.ids[i / 2]] == 1) own[k] = t->held[i] == 0 ? points[i] : same ? YOUNG * same[k] : 0, ++k;
    VecRestoreArray(vector, &own);
    if (held) VecRestoreArrayRead(held, &same);
}

/* y = K x; what supports hold is a diagonal of its own, for the multigrid moves it, too. */
static inline PetscErrorCode multiply(Mat a, Vec x, Vec y) {
    plate *t;
    MatShellGetContext(a, &t);
    take(t, x, t->in);
    must(t->body, peri_multiply_stiffness(t->body, t->in, t->out, 2 * t->p.points));
    give(t, t->out, y, x);
    return 0;
}

/* Rigid motions, which the multigrid keeps. */
static inline void tell_motions(const plate *t, Mat a, Vec like) {
    Vec places;
    PetscScalar *x;
    MatNullSpace motions;
    VecDuplicate(like, &places);
    VecGetArray(places, &x);
    for (int64_t i = 0, k = 0; i < t->p.points; ++i) {
        const int64_t cell = t->p.ids[i];
        if (t->p.mine[cell] == 1) x[k++] = (double)(cell % t->p.cells[0]) * H, x[k++] = (double)(cell / t->p.cells[0]) * H;
    }
    VecRestoreArray(places, &x);
    MatNullSpaceCreateRigidBody(places, &motions);
    MatSetNearNullSpace(a, motions);
    MatNullSpaceDestroy(&motions), VecDestroy(&places);
}

/* The solver of a plate whose supports stand. */
static inline void make_solver(plate *t) {
    PC levels;
    const int64_t n = 2 * t->p.points;
    t->number = (PetscInt *)room(t->p.count, sizeof *t->number);
    for (int other = 0, next = 0; other < t->p.ranks; ++other)
        for (int64_t i = 0; i < t->p.count; ++i)
            if (t->p.owner[i] == other) t->number[i] = next++;
    t->own = (PetscInt)(t->p.points - t->p.ghost_count);
    t->held = (double *)room(n, sizeof(double)), t->in = (double *)room(n, sizeof(double)), t->out = (double *)room(n, sizeof(double));
    must(t->body, peri_get_field(t->body, PERI_FIELD_HELD, t->held, n));
    MatCreateShell(PETSC_COMM_WORLD, 2 * t->own, 2 * t->own, PETSC_DETERMINE, PETSC_DETERMINE, t, &t->k);
    MatShellSetOperation(t->k, MATOP_MULT, (void (*)(void))multiply);
    MatCreateVecs(t->k, &t->u, &t->force);
    VecSetBlockSize(t->u, 2);
    KSPCreate(PETSC_COMM_WORLD, &t->solver);
    KSPSetType(t->solver, KSPCG), KSPSetNormType(t->solver, KSP_NORM_UNPRECONDITIONED);
    KSPSetTolerances(t->solver, ACCURACY, 0, PETSC_DEFAULT, 1000);
    KSPGetPC(t->solver, &levels), PCSetType(levels, PCGAMG);
    KSPSetErrorIfNotConverged(t->solver, PETSC_TRUE);
    KSPSetFromOptions(t->solver);
}

/* The preconditioner, of the bonds that are left. */
static inline void renew_proxy(plate *t) {
    MatDestroy(&t->proxy);
    t->proxy = make_proxy(t);
    tell_motions(t, t->proxy, t->u);
    KSPSetOperators(t->solver, t->k, t->proxy);
}

static inline void free_plate(plate *t) {
    KSPDestroy(&t->solver), MatDestroy(&t->k), MatDestroy(&t->proxy), VecDestroy(&t->u), VecDestroy(&t->force);
    free(t->number), free(t->held), free(t->in), free(t->out);
    part_free(&t->p), peri_body_destroy(t->body);
}

#endif
