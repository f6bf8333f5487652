/* SPDX-License-Identifier: MIT */
/* plate.c - the equilibrium of a cracked plate by PETSc (shell.h), on as many processes as mpirun starts; and by peri_solve, on process 0.
     mpicc -I. $(pkg-config --cflags petsc) examples/petsc/plate.c build/libperi.a $(pkg-config --libs petsc) -lm -o plate
     mpirun -n 4 plate -cells 200 */
#include <math.h>

#include "shell.h"

static PetscInt cells = 100, cracks = 3; /* along a side; in the plate */

/* Cracked, clamped at the left, drawn down at the right. */
static void load_plate(peri_body *b) {
    static const double at[3][3] = {{0.2, 1, 0.35}, {0.5, 0, 0.65}, {0.8, 1, 0.35}}; /* x; y from, to: of the side */
    const double side = (double)cells * H, lo[2] = {0, 0}, hi[2] = {side, side}, clamp[2] = {6 * H, side}, edge[2] = {side - 3 * H, 0};
    const double down[2] = {0, -1e6}; /* [Pa] */
    for (int k = 0; k < cracks && k < 3; ++k) {
        const double from[2] = {at[k][0] * side, at[k][1] * side}, to[2] = {at[k][0] * side, at[k][2] * side};
        must(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    }
    must(b, peri_prescribe_displacement(b, (int32_t)must(b, peri_select_box(b, NULL, lo, clamp)), PERI_AXIS_XY, NULL, NULL, NULL));
    must(b, peri_apply_layer_traction(b, (int32_t)must(b, peri_select_box(b, NULL, edge, hi)), 3 * H, down, NULL, NULL));
}

/* What peri_solve makes of the whole plate: the displacement of the corner. */
static double solve_alone(int64_t *iterations) {
    peri_solve_desc solve;
    peri_solve_report report;
    const int64_t count = 2 * (int64_t)cells * cells;
    peri_body *b = start_plate(NULL, cells, cells, 0);
    double *u = (double *)room(count, sizeof *u);
    load_plate(b);
    peri_solve_desc_init(&solve);
    solve.tolerance = ACCURACY;
    must(b, peri_solve(b, &solve, &report));
    must(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, count));
    const double tip = u[count - 1];
    *iterations = report.iterations;
    free(u), peri_body_destroy(b);
    return tip;
}

int main(int argc, char **argv) {
    plate t;
    peri_evaluate_desc loads;
    PetscInt iterations;
    double tip = 0;
    PetscInitialize(&argc, &argv, NULL, NULL);
    PetscPushErrorHandler(PetscMPIAbortErrorHandler, NULL); /* one that fails ends all */
    PetscOptionsGetInt(NULL, NULL, "-cells", &cells, NULL), PetscOptionsGetInt(NULL, NULL, "-cracks", &cracks, NULL);
    memset(&t, 0, sizeof t);
    t.body = start_plate(&t.p, cells, cells, 0);
    load_plate(t.body);
    make_solver(&t);
    renew_proxy(&t);
    peri_evaluate_desc_init(&loads);
    loads.bonds = 0, loads.nodal = 1, loads.force = t.out;
    must(t.body, peri_evaluate(t.body, &loads, NULL));
    give(&t, t.out, t.force, NULL);
    KSPSolve(t.solver, t.force, t.u);
    KSPGetIterationNumber(t.solver, &iterations);
    take(&t, t.u, t.out);
    for (int64_t i = 0; i < t.p.points; ++i)
        if (t.p.ids[i] == t.p.count - 1 && t.p.mine[t.p.count - 1] == 1) tip = t.out[2 * i + 1];
    MPI_Allreduce(MPI_IN_PLACE, &tip, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    if (t.p.rank == 0) {
        int64_t others;
        const double whole = solve_alone(&others);
        printf("%d processes: tip %.12e m, %d iterations; peri_solve: %.12e m, %ld iterations; apart by %.1e\n", t.p.ranks, tip, (int)iterations,
               whole, (long)others, fabs(tip / whole - 1));
    }
    free_plate(&t);
    PetscFinalize();
    return 0;
}
