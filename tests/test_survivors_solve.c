/* SPDX-License-Identifier: MIT */
/* test_survivors_solve.c - what `make mutants` found that no other test of equilibria looked at.

   SOURCE OF TRUTH: peri.h and docs/statics.md; the definition of the residual, worked out from the fields; balance of forces; conjugate
   gradients end after as many iterations as there are unknowns; a multilevel preconditioner is there to need fewer iterations, and not more
   of them for a larger body. */
#include "refusal.h"

/* ---- a plate with its left side held ------------------------------------------------------------------------------- */

static peri_body *plate(int32_t space, int32_t law, int nx, int ny, int nz, int32_t geometry) {
    specimen s = specimen_of(space, law, 0.3, 1, 2.2, nx, ny, nz);
    s.desc.geometry = geometry;
    return specimen_make(&s);
}

static int32_t side(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e9, -1e9}, hi[3] = {to, 1e9, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

static peri_solve_report solve(peri_body *b, int32_t method, int32_t preconditioner, double tolerance) {
    peri_solve_desc s;
    peri_solve_report r;
    peri_solve_desc_init(&s);
    s.method = method;
    s.preconditioner = preconditioner;
    s.tolerance = tolerance;
    memset(&r, 0, sizeof r);
    MUST(b, peri_solve(b, &s, &r));
    return r;
}

/* ---- iterations ---------------------------------------------------------------------------------------------------- */

static int64_t iterations_of(int32_t space, int32_t law, int nx, int ny, int nz, int32_t preconditioner) {
    const double force[3] = {1e-3, 2e-3, -1e-3};
    peri_body *b = plate(space, law, nx, ny, nz, PERI_GEOMETRY_LINEAR);
    MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), peri_dimension(b) == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, nx - 3, nx), force, NULL, NULL));
    const peri_solve_report r = solve(b, PERI_METHOD_NEWTON, preconditioner, 1e-6);
    peri_body_destroy(b);
    return r.iterations;
}

/* 4 x 3 cells, the first three columns of which are held: 6 unknowns. */
static void gradients_end_with_the_unknowns(void) {
    static const int32_t preconditioners[3] = {PERI_PRECONDITIONER_NONE, PERI_PRECONDITIONER_BLOCK_JACOBI, PERI_PRECONDITIONER_MULTILEVEL};
    int k;
    for (k = 0; k < 3; ++k) {
        const int64_t n = iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 4, 3, 1, preconditioners[k]);
        CHECK(n > 0 && n <= 6);
    }
    CHECK(iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 8, 2, 1, PERI_PRECONDITIONER_NONE) <= 20);
}

static void levels_save_iterations(void) {
    const int64_t blocks = iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 120, 24, 1, PERI_PRECONDITIONER_BLOCK_JACOBI);
    const int64_t levels = iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 120, 24, 1, PERI_PRECONDITIONER_MULTILEVEL);
    const int64_t small = iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 30, 6, 1, PERI_PRECONDITIONER_MULTILEVEL);
    CHECK(8 * levels < blocks);
    CHECK(levels <= 2 * small);
    const int64_t solid = iterations_of(PERI_SPACE_SOLID, PERI_LAW_LPS, 40, 8, 8, PERI_PRECONDITIONER_MULTILEVEL);
    const int64_t cube = iterations_of(PERI_SPACE_SOLID, PERI_LAW_LPS, 12, 8, 8, PERI_PRECONDITIONER_MULTILEVEL);
    CHECK(solid <= 2 * cube);
}

/* ---- residuals ----------------------------------------------------------------------------------------------------- */

typedef struct told {
    double residual;
    int64_t iterations;
} told;

static int32_t listen(void *user, int64_t iteration, double residual) {
    told *t = (told *)user;
    t->residual = residual;
    t->iterations = iteration;
    return 0;
}

/* |r| of free components over the larger of |loads| and |reactions|, in forces: a coarse tolerance leaves much of it. The left side is held
   along x alone and moves, one point across; so components of one point are free and not. */
static void residuals_are_as_defined(void) {
    int pulled;
    for (pulled = 0; pulled < 2; ++pulled) {
        const double move[2] = {0.01, 0}, force[2] = {0, 1e-3};
        peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 14, 6, 1, PERI_GEOMETRY_LINEAR);
        const int32_t left = side(b, 0, 2), right = side(b, 12, 14), corner[1] = {0};
        const int32_t point = (int32_t)MUST(b, peri_select_points(b, NULL, 1, corner));
        peri_solve_desc s;
        peri_solve_report r;
        told t = {0, 0};
        MUST(b, peri_prescribe_displacement(b, left, PERI_AXIS_X, NULL, NULL, NULL));
        MUST(b, peri_prescribe_displacement(b, point, PERI_AXIS_Y, NULL, NULL, NULL));
        if (pulled) MUST(b, peri_prescribe_displacement(b, right, PERI_AXIS_X, move, NULL, NULL));
        else MUST(b, peri_apply_body_force(b, right, force, NULL, NULL));
        peri_solve_desc_init(&s);
        s.preconditioner = PERI_PRECONDITIONER_BLOCK_JACOBI;
        s.tolerance = 0.02;
        s.on_iteration = listen;
        s.user = &t;
        MUST(b, peri_solve(b, &s, &r));
        CHECK(t.iterations == r.iterations && r.iterations > 1);
        double *f = get(b, PERI_FIELD_FORCE_DENSITY), *x = get(b, PERI_FIELD_POSITION), *held = get(b, PERI_FIELD_REACTION);
        double left_over = 0, reactions = 0, loads = 0;
        int i, d;
        for (i = 0; i < 84; ++i)
            for (d = 0; d < 2; ++d) {
                const int constrained = (d == 0 && (x[2 * i] < 2 || (pulled && x[2 * i] > 12))) || (d == 1 && i == 0);
                if (constrained) reactions += held[2 * i + d] * held[2 * i + d];
                else left_over += f[2 * i + d] * f[2 * i + d];
                if (!constrained && !pulled && x[2 * i] > 12) loads += force[d] * force[d];
            }
        CHECK_NEAR(r.residual, sqrt(left_over / fmax(reactions, loads)), 1e-6, 0);
        CHECK_NEAR(t.residual, r.residual, 1e-3, 0);
        CHECK(r.residual > 1e-4 && r.residual <= 0.02);
        free(f);
        free(x);
        free(held);
        peri_body_destroy(b);
    }
}

/* ---- supports ------------------------------------------------------------------------------------------------------ */

/* "Later supports win", component by component. */
static void later_supports_win(void) {
    const double first[2] = {0.5, 0.25}, second[2] = {-0.125, 9};
    int64_t k;
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 8, 4, 1, PERI_GEOMETRY_LINEAR);
    const int32_t left = side(b, 0, 3), all = PERI_ALL;
    MUST(b, peri_prescribe_displacement(b, left, PERI_AXIS_XY, first, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, all, PERI_AXIS_X, second, NULL, NULL));
    (void)solve(b, PERI_METHOD_NEWTON, PERI_PRECONDITIONER_MULTILEVEL, 1e-10);
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    for (k = 0; k < 32; ++k) {
        CHECK_NEAR(u[2 * k], -0.125, 1e-12, 0);
        CHECK_NEAR(u[2 * k + 1], 0.25, 1e-9, 0); /* the right side moves along */
    }
    free(u);
    peri_body_destroy(b);
}

/* Reactions are those of the equilibrium, whatever steps came before: they hold the loads. */
static void reactions_are_of_the_equilibrium(void) {
    const double force[2] = {1e-3, -2e-3};
    double held[2];
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 10, 4, 1, PERI_GEOMETRY_LINEAR);
    const int32_t support = (int32_t)MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, 8, 10), force, NULL, NULL)); /* 8 points of volume 1 */
    MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0, 0));
    (void)solve(b, PERI_METHOD_NEWTON, PERI_PRECONDITIONER_MULTILEVEL, 1e-10);
    MUST(b, peri_get_reaction(b, support, held));
    CHECK_NEAR(held[0], -8 * force[0], 1e-8, 0);
    CHECK_NEAR(held[1], -8 * force[1], 1e-8, 0);
    peri_body_destroy(b);
}

/* "in peri_solve time is the load factor": and of forces that are read after it, of the body as the solve left it. */
static void forces_after_a_solve_are_at_its_factor(void) {
    const double from[2] = {5, -9}, to[2] = {5, 9};
    double time = -1, f[80];
    peri_solve_desc s;
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 10, 4, 1, PERI_GEOMETRY_LINEAR);
    MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, note_time, &time));
    MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0, 0));
    peri_solve_desc_init(&s);
    s.load_to = 0.625;
    MUST(b, peri_solve(b, &s, NULL));
    CHECK(time == 0.625);
    time = -1;
    CHECK(peri_cut_segment(b, PERI_CUT_NOW, from, to) > 0);
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 80));
    CHECK(time == 0.625);
    peri_body_destroy(b);
}

/* ---- what is refused ----------------------------------------------------------------------------------------------- */

static int32_t write_some(void *user, const void *bytes, int64_t count) {
    (void)bytes;
    (void)count;
    return --*(int *)user < 0;
}

static void solves_name_what_is_wrong(void) {
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 6, 4, 1, PERI_GEOMETRY_LINEAR);
    peri_solve_desc s;
    peri_solve_report r, zero;
    peri_matrix *a = NULL;
    double in[48] = {0}, out[48];
    int calls;
    memset(&zero, 0, sizeof zero);
    memset(&r, 0x55, sizeof r);
    peri_solve_desc_init(&s);
    s.tolerance = 1; /* [0, 1) */
    REFUSE(b, PERI_ERROR_RANGE, peri_solve(b, &s, &r));
    CHECK(strcmp(seen.field, "tolerance") == 0 && seen.value == 1);
    CHECK(memcmp(&r, &zero, sizeof r) == 0); /* nothing was done */
    in[5] = HUGE_VAL;
    REFUSE(b, PERI_ERROR_RANGE, peri_multiply_stiffness(b, in, out, 48));
    CHECK(strcmp(seen.field, "in") == 0 && seen.index == 5);
    REFUSE(b, PERI_ERROR_EMPTY, peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1, NULL, NULL)); /* no bond of it is cut */
    CHECK(strcmp(seen.field, "set") == 0);
    MUST(b, peri_matrix_create(b, &a));
    for (calls = 0; calls < 6; ++calls) {
        int left = calls;
        CHECK(peri_export_matrix_to(a, write_some, &left) == PERI_ERROR_WRITE);
    }
    peri_matrix_destroy(a);
    peri_body_destroy(b);
}

/* A product is linear: of vectors of any size, in single precision, too. */
static void products_have_any_size(void) {
    static const int powers[4] = {-900, -200, 200, 900};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0.3, 1, 2.2, 5, 4, 1);
    double in[40], plain[40], out[40];
    int k, n;
    s.desc.precision = PERI_PRECISION_SINGLE;
    peri_body *b = specimen_make(&s);
    for (k = 0; k < 40; ++k) in[k] = sin(k * k + 1.0);
    MUST(b, peri_multiply_stiffness(b, in, plain, 40));
    for (n = 0; n < 4; ++n) {
        for (k = 0; k < 40; ++k) out[k] = ldexp(in[k], powers[n]);
        MUST(b, peri_multiply_stiffness(b, out, out, 40));
        for (k = 0; k < 40; ++k) CHECK(out[k] == ldexp(plain[k], powers[n]));
    }
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(gradients_end_with_the_unknowns);
    RUN(levels_save_iterations);
    RUN(residuals_are_as_defined);
    RUN(later_supports_win);
    RUN(reactions_are_of_the_equilibrium);
    RUN(forces_after_a_solve_are_at_its_factor);
    RUN(solves_name_what_is_wrong);
    RUN(products_have_any_size);
    return test_end("test_survivors_solve");
}
