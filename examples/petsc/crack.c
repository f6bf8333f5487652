/* SPDX-License-Identifier: MIT */
/* crack.c - a double cantilever is opened, step by step, and its crack grows: quasi-static fracture by PETSc (shell.h), on as many processes
   as mpirun starts; and by peri_solve, on process 0, with the same bonds broken at the same steps.

   Each step moves the upper end and solves K d = r, the force that is out of balance (peri_evaluate at u), for u += d. Where bonds are then
   over their limit all of those break at once (`fracture`), the proxy loses them, too, and the equilibrium is sought anew.
     mpicc -I. $(pkg-config --cflags petsc) examples/petsc/crack.c build/libperi.a $(pkg-config --libs petsc) -lm -o crack */
#include <math.h>

#include "shell.h"

#define NX    36
#define NY    16
#define STEPS 5
#define LIMIT 1e-3          /* critical stretch */
#define PULL  (0.15 * H)    /* [m] the last displacement of the upper end */

static int is_end(int64_t cell) { return cell % NX < 6 && cell / NX >= NY / 2; }

/* Cracked from the left along its middle; the lower end is held, and the upper one, which moves. */
static int32_t load_strip(peri_body *b, const double *pull) {
    const double lo[2] = {0, 0}, middle[2] = {6 * H, NY / 2 * H}, below[2] = {0, NY / 2 * H}, top[2] = {6 * H, NY * H}, tip[2] = {16 * H, NY / 2 * H};
    must(b, peri_cut_segment(b, PERI_CUT_INITIAL, below, tip));
    const int32_t lower = (int32_t)must(b, peri_select_box(b, NULL, lo, middle)), upper = (int32_t)must(b, peri_select_box(b, NULL, below, top));
    must(b, peri_set_no_fail(b, lower, 1)), must(b, peri_set_no_fail(b, upper, 1));
    must(b, peri_prescribe_displacement(b, lower, PERI_AXIS_XY, NULL, NULL, NULL));
    return (int32_t)must(b, peri_prescribe_displacement(b, upper, PERI_AXIS_XY, pull, NULL, NULL));
}

/* The force that is out of balance at u, to t->force; returns what opens the upper end, [N/m]. */
static double read_residual(plate *t, const double *u) {
    peri_evaluate_desc e;
    double end = 0;
    peri_evaluate_desc_init(&e);
    e.displacement = u, e.nodal = 1, e.force = t->out;
    must(t->body, peri_evaluate(t->body, &e, NULL));
    give(t, t->out, t->force, NULL);
    for (int64_t i = 0; i < t->p.points; ++i)
        if (t->p.mine[t->p.ids[i]] == 1 && is_end(t->p.ids[i])) end -= t->out[2 * i + 1];
    MPI_Allreduce(MPI_IN_PLACE, &end, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return end;
}

/* The equilibrium and what breaks in it, again and again, until nothing does. u: of the points of the part. Returns the force of the end. */
static double settle(plate *t, double *u, int64_t *broken, int64_t *solves, int64_t *iterations) {
    peri_evaluate_desc e;
    peri_evaluate_report report;
    PetscInt some;
    double force;
    peri_evaluate_desc_init(&e);
    e.displacement = u, e.fracture = 1;
    do {
        renew_proxy(t);
        (void)read_residual(t, u);
        KSPSolve(t->solver, t->force, t->u);
        KSPGetIterationNumber(t->solver, &some);
        *iterations += some, ++*solves;
        take(t, t->u, t->in);
        for (int64_t i = 0; i < 2 * t->p.points; ++i) u[i] += t->in[i];
        force = read_residual(t, u);
        must(t->body, peri_evaluate(t->body, &e, &report));
        *broken += report.broken;
    } while (report.broken > 0);
    return force;
}

typedef struct curve { /* force of the end and bonds broken, by steps */
    double  force[STEPS];
    int64_t broken[STEPS], steps;
    int32_t end;
} curve;

static int32_t note_step(void *user, peri_body *b) {
    curve *c = (curve *)user;
    double force[2];
    must(b, peri_get_reaction(b, c->end, force));
    if (c->steps < STEPS) c->force[c->steps] = force[1], c->broken[c->steps++] = peri_broken_count(b);
    return 0;
}

static void solve_alone(curve *c) {
    const double pull[2] = {0, PULL};
    peri_solve_desc solve;
    peri_body *b = start_plate(NULL, NX, NY, LIMIT);
    c->end = load_strip(b, pull);
    peri_solve_desc_init(&solve);
    solve.steps = STEPS, solve.criticality = 0, solve.tolerance = 1e-10, solve.on_step = note_step, solve.user = c;
    must(b, peri_solve(b, &solve, NULL));
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    const double none[2] = {0, 0};
    plate t;
    curve c;
    PetscInitialize(&argc, &argv, NULL, NULL);
    PetscPushErrorHandler(PetscMPIAbortErrorHandler, NULL);
    memset(&t, 0, sizeof t), memset(&c, 0, sizeof c);
    t.body = start_plate(&t.p, NX, NY, LIMIT);
    (void)load_strip(t.body, none);
    make_solver(&t);
    double *u = (double *)room(2 * t.p.points, sizeof *u), most = 0;
    int64_t broken = 0, solves = 0, iterations = 0, apart = 0;
    double worst = 0;
    if (t.p.rank == 0) solve_alone(&c);
    for (int step = 0; step < STEPS; ++step) {
        for (int64_t i = 0; i < t.p.points; ++i)
            if (is_end(t.p.ids[i])) u[2 * i + 1] = PULL * (step + 1) / STEPS;
        const double force = settle(&t, u, &broken, &solves, &iterations);
        most = fmax(most, fabs(force));
        worst = fmax(worst, fabs(force - c.force[step]));
        apart += llabs(broken - c.broken[step]);
        if (t.p.rank == 0)
            printf("%.4e m: %.9e N/m, %ld broken; peri_solve: %.9e N/m, %ld\n", PULL * (step + 1) / STEPS, force, (long)broken, c.force[step],
                   (long)c.broken[step]);
    }
    if (t.p.rank == 0)
        printf("%d processes: %ld equilibria of %.1f iterations, %ld bonds broken, %ld apart by steps, forces by %.1e\n", t.p.ranks, (long)solves,
               (double)iterations / (double)solves, (long)broken, (long)apart, worst / most);
    free(u), free_plate(&t);
    PetscFinalize();
    return 0;
}
