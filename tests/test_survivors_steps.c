/* SPDX-License-Identifier: MIT */
/* test_survivors_steps.c - what `make mutants` found that no other test of load steps, and of how solves end, looked at.

   SOURCE OF TRUTH: peri.h and docs/statics.md (Load factors, One equilibrium, What a failed solve leaves); work is force times way;
   balance of forces; a body that was solved otherwise is in the same equilibrium; calls that only read or multiply change nothing. */
#include "refusal.h"

static int32_t side(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e9, -1e9}, hi[3] = {to, 1e9, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}
static peri_solve_desc settings(double tolerance) {
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    s.tolerance = tolerance;
    return s;
}
static peri_solve_report solve(peri_body *b, const peri_solve_desc *s) {
    peri_solve_report r;
    memset(&r, 0, sizeof r);
    MUST(b, peri_solve(b, s, &r));
    return r;
}
/* Its first three columns are held. */
static peri_body *plate(int32_t law, int nx, int ny, int32_t geometry, int32_t precision) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 1, 2.2, nx, ny, 1);
    s.desc.geometry = geometry;
    s.desc.precision = precision;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    return b;
}
static peri_body *linear(void) { return plate(PERI_LAW_BOND_BASED, 12, 4, PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE); }
static double apart(peri_body *a, peri_body *b) { /* of displacements, over the largest */
    double *u = get(a, PERI_FIELD_DISPLACEMENT), *v = get(b, PERI_FIELD_DISPLACEMENT), most = 0, size;
    const int64_t n = peri_size_of_field(a, PERI_FIELD_DISPLACEMENT);
    int64_t k;
    for (k = 0; k < n; ++k) most = fmax(most, fabs(u[k] - v[k]));
    size = fmax(largest(u, n), largest(v, n));
    free(u);
    free(v);
    return most / size;
}

/* ---- one equilibrium ------------------------------------------------------------------------------------------------ */

/* Default tolerances are those of the table: the same iterations as with the number given. */
static void default_tolerances(void) {
    static const double tolerances[3] = {1e-8, 1e-5, 1e-4};
    int p;
    for (p = 0; p < 3; ++p) {
        const double force[2] = {1e-3, 2e-3};
        peri_solve_report r[2];
        int given;
        for (given = 0; given < 2; ++given) {
            peri_body *b = plate(PERI_LAW_LPS, 12, 4, PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE + p);
            peri_solve_desc s = settings(given ? tolerances[p] : 0);
            MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
            r[given] = solve(b, &s);
            peri_body_destroy(b);
        }
        CHECK(r[0].iterations == r[1].iterations && r[0].residual == r[1].residual && r[0].residual > tolerances[p] / 1000);
    }
}

/* "Where the geometry is linear and there are no obstacles the first iteration ends it": none that are left. */
static void removed_obstacles_are_none(void) {
    const double force[2] = {1e-3, 2e-3}, place[2] = {0, -50}, normal[2] = {0, 1};
    peri_body *b = linear();
    peri_solve_desc s = settings(1e-8);
    const int32_t ground = (int32_t)MUST(b, plane_obstacle(b, place, normal, 1, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    MUST(b, peri_remove_obstacle(b, ground));
    CHECK(solve(b, &s).newton == 1);
    peri_body_destroy(b);
}

/* A bar of linear geometry is pulled down onto a stiff ground that it does not touch at rest: what the ground and the supports give is what
   pulls. */
static void bars_come_to_rest_on_the_ground(void) {
    const double down[2] = {0, -2e-2}, place[2] = {0, 0.3}, normal[2] = {0, 1};
    double force[2], *held, sum = 0;
    peri_body *b = plate(PERI_LAW_BOND_BASED, 24, 4, PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE);
    peri_solve_desc s = settings(1e-8);
    int k;
    const int32_t ground = (int32_t)MUST(b, plane_obstacle(b, place, normal, 50, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, 3, 24), down, NULL, NULL));
    (void)solve(b, &s);
    MUST(b, peri_get_obstacle_force(b, ground, force, NULL));
    held = get(b, PERI_FIELD_REACTION);
    for (k = 0; k < 96; ++k) sum += held[2 * k + 1];
    CHECK(force[1] > 0.2);
    CHECK_NEAR(force[1] + sum, 84 * 2e-2, 1e-6, 0);
    free(held);
    peri_body_destroy(b);
}

static int32_t stop_at(void *user, int64_t iteration, double residual) {
    (void)residual;
    return iteration >= *(const int64_t *)user;
}
static int32_t stop_as_asked(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user;
    (void)time;
    (void)count;
    (void)points;
    (void)value;
    return 1;
}
/* "linear: with what the linear solver had found"; a load "stops as peri_iteration_fn does": after one iteration, short of the
   equilibrium. */
static void stopped_solves(void) {
    const double force[2] = {0, 1e-3};
    int64_t at = 3;
    double *u;
    peri_solve_desc s = settings(1e-10);
    peri_solve_report r;
    peri_body *b = linear();
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    s.preconditioner = PERI_PRECONDITIONER_BLOCK_JACOBI;
    s.on_iteration = stop_at;
    s.user = &at;
    CHECK(peri_solve(b, &s, &r) == PERI_STOPPED && r.iterations == 3);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(largest(u, 96) > 1e-4);
    free(u);
    peri_body_destroy(b);
    b = linear();
    s.on_iteration = NULL;
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, stop_as_asked, NULL));
    CHECK(peri_solve(b, &s, &r) == PERI_STOPPED && r.iterations == 1);
    peri_body_destroy(b);
}

/* A tolerance out of reach "ends": not after as many iterations as are allowed. */
static void out_of_reach_ends(void) {
    const double force[2] = {0, 1e-3};
    peri_body *b = linear();
    peri_solve_desc s = settings(1e-40);
    peri_solve_report r;
    s.newton = 1000;
    s.iterations = INT64_MAX / 2;
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &s, &r));
    CHECK(seen.value > 0 && seen.value < 1e-13 && r.newton < 100);
    peri_body_destroy(b);
}

/* Where nothing acts the residual is 0, of a body that is turned, too: rounding over rounding tells nothing. */
static void turned_bodies_are_at_rest(void) {
    specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1, 2.2, 7, 5, 1);
    peri_body *b = specimen_make(&p);
    double *x = get(b, PERI_FIELD_POSITION), u[70];
    peri_solve_desc s = settings(0);
    peri_solve_report r;
    int k;
    for (k = 0; k < 35; ++k) {
        u[2 * k] = (cos(0.7) - 1) * x[2 * k] - sin(0.7) * x[2 * k + 1];
        u[2 * k + 1] = sin(0.7) * x[2 * k] + (cos(0.7) - 1) * x[2 * k + 1];
    }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    s.loose = PERI_LOOSE_BALANCED;
    r = solve(b, &s);
    CHECK(r.residual == 0 && r.loose == 3);
    s.method = PERI_METHOD_RELAXATION;
    CHECK(solve(b, &s).residual == 0);
    free(x);
    peri_body_destroy(b);
}

/* Loads that are too small are refused where nothing else acts, and not beside an obstacle that presses; by relaxation, too. */
static void small_loads(void) {
    const double tiny[2] = {1e-200, 0}, place[2] = {0, 0.7}, normal[2] = {0, 1};
    int method;
    for (method = PERI_METHOD_NEWTON; method <= PERI_METHOD_RELAXATION; ++method) {
        peri_body *b = linear();
        peri_solve_desc s = settings(0);
        double force[2];
        s.method = method;
        MUST(b, peri_apply_body_force(b, side(b, 9, 12), tiny, NULL, NULL));
        REFUSE(b, PERI_ERROR_RANGE, peri_solve(b, &s, NULL));
        const int32_t ground = (int32_t)MUST(b, plane_obstacle(b, place, normal, 0.1, NULL, NULL));
        (void)solve(b, &s);
        MUST(b, peri_get_obstacle_force(b, ground, force, NULL));
        CHECK(force[1] > 0);
        peri_body_destroy(b);
    }
}

/* Relaxation: supports hold, and are where they are prescribed; the equilibrium is Newton's. */
static void relaxation_heeds_supports(void) {
    const double move[2] = {0.05, 0.02}, force[2] = {0, 1e-3};
    peri_body *b[2];
    double *u;
    int k;
    for (k = 0; k < 2; ++k) {
        peri_solve_desc s = settings(1e-7);
        b[k] = linear();
        MUST(b[k], peri_prescribe_displacement(b[k], side(b[k], 9, 12), PERI_AXIS_XY, move, NULL, NULL));
        MUST(b[k], peri_apply_body_force(b[k], side(b[k], 5, 7), force, NULL, NULL));
        if (k) s.method = PERI_METHOD_RELAXATION;
        (void)solve(b[k], &s);
    }
    u = get(b[1], PERI_FIELD_DISPLACEMENT);
    for (k = 0; k < 48; ++k) {
        if (k % 12 < 3) CHECK(u[2 * k] == 0 && u[2 * k + 1] == 0);
        if (k % 12 >= 9) CHECK(fabs(u[2 * k] - 0.05) < 1e-15 && fabs(u[2 * k + 1] - 0.02) < 1e-15);
    }
    CHECK(apart(b[0], b[1]) < 1e-4);
    free(u);
    peri_body_destroy(b[0]);
    peri_body_destroy(b[1]);
}

/* ---- tolerance of energy -------------------------------------------------------------------------------------------- */

/* It is of each equilibrium: a second step after a far smaller one takes no more iterations than alone. */
static int32_t tiny_first(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)points;
    for (k = 0; k < count; ++k) value[2 * k + 1] = *(const double *)user * (time < 0.75 ? 1e-6 : 1.0);
    return 0;
}
static void energy_is_of_each_equilibrium(void) {
    double force = 1e-3;
    int64_t n[2];
    int steps;
    for (steps = 1; steps <= 2; ++steps) {
        peri_body *b = linear();
        peri_solve_desc s = settings(1e-14);
        s.preconditioner = PERI_PRECONDITIONER_BLOCK_JACOBI;
        s.energy_tolerance = 1e-2;
        s.steps = steps;
        MUST(b, peri_apply_body_force(b, side(b, 9, 12), NULL, tiny_first, &force));
        n[steps - 1] = solve(b, &s).iterations;
        peri_body_destroy(b);
    }
    CHECK(n[1] <= 2 * n[0] + 4);
}

/* Of nonlinear bodies the residual itself has to fall, not what the first tangent makes of it. */
static void energy_of_nonlinear_bodies(void) {
    const double force[2] = {0, 0.05};
    peri_solve_desc s = settings(1e-9);
    peri_body *b = plate(PERI_LAW_BOND_BASED, 12, 4, PERI_GEOMETRY_NONLINEAR, PERI_PRECISION_DOUBLE);
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    s.energy_tolerance = 0.1;
    const peri_solve_report r = solve(b, &s);
    CHECK(r.residual < 0.5);
    peri_body_destroy(b);
}

/* ---- load steps ----------------------------------------------------------------------------------------------------- */

typedef struct steps {
    int64_t count;
    int32_t load;
    double at[64];
} steps;
static int32_t note_step(void *user, peri_body *b) {
    steps *t = (steps *)user;
    if (t->count < 64) t->at[t->count] = peri_load_factor(b);
    t->count++;
    return 0;
}

/* on_step that does nothing frees nothing: what steps left open is the error. */
static void steps_that_do_nothing(void) {
    const double force[2] = {0.05, 0.01};
    peri_body *b = plate(PERI_LAW_BOND_BASED, 12, 4, PERI_GEOMETRY_NONLINEAR, PERI_PRECISION_DOUBLE);
    peri_solve_desc s = settings(1e-9);
    steps t;
    peri_energy e;
    memset(&t, 0, sizeof t);
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    s.steps = 2;
    s.on_step = note_step;
    s.user = &t;
    (void)solve(b, &s);
    MUST(b, peri_get_energy(b, &e));
    CHECK(t.count == 2 && t.at[0] == 0.5 && t.at[1] == 1); /* peri_load_factor, in the first solve, too */
    CHECK(e.damping == 0 && e.error != 0);
    peri_body_destroy(b);
}

/* on_step takes away a support: from then on the body is as one that never had it. No ledger, which would look at supports, too. */
static int32_t let_go(void *user, peri_body *b) {
    steps *t = (steps *)user;
    if (t->count++ == 0) MUST(b, peri_remove_load(b, t->load));
    return 0;
}
static void supports_taken_away(void) {
    const double force[2] = {1e-3, 2e-3};
    peri_body *b[2];
    int k;
    for (k = 0; k < 2; ++k) {
        specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0.3, 1, 2.2, 12, 4, 1);
        peri_solve_desc s = settings(1e-10);
        steps t;
        memset(&t, 0, sizeof t);
        p.desc.geometry = PERI_GEOMETRY_LINEAR;
        p.desc.ledger = 0;
        b[k] = specimen_make(&p);
        MUST(b[k], peri_prescribe_displacement(b[k], side(b[k], 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
        MUST(b[k], peri_apply_body_force(b[k], side(b[k], 6, 9), force, NULL, NULL));
        if (k) t.load = (int32_t)MUST(b[k], peri_prescribe_displacement(b[k], side(b[k], 9, 12), PERI_AXIS_XY, NULL, NULL, NULL));
        s.steps = 2;
        s.on_step = k ? let_go : NULL;
        s.user = &t;
        (void)solve(b[k], &s);
    }
    CHECK(apart(b[0], b[1]) < 1e-7);
    peri_body_destroy(b[0]);
    peri_body_destroy(b[1]);
}

/* on_step adds a load that does not grow: over the next step it works by all of its force, and the load that grows by the mean of it. */
typedef struct second {
    int64_t count;
    double *first; /* displacements as it was added */
} second;
static int32_t as_it_is(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user;
    (void)time;
    (void)count;
    (void)points;
    (void)value;
    return 0;
}
static int32_t push_more(void *user, peri_body *b) {
    const double more[2] = {0, 2e-3};
    second *t = (second *)user;
    if (t->count++ > 0) return 0;
    t->first = get(b, PERI_FIELD_DISPLACEMENT);
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), more, as_it_is, NULL));
    return 0;
}
static void work_of_a_second_load(void) {
    const double force[2] = {1e-3, 0};
    second t = {0, NULL};
    peri_body *b = linear();
    peri_solve_desc s = settings(1e-11);
    peri_energy e;
    double *u, work = 0;
    int k;
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    s.steps = 2;
    s.on_step = push_more;
    s.user = &t;
    (void)solve(b, &s);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    for (k = 0; k < 48; ++k)
        if (k % 12 >= 9) {
            work += 0.25e-3 * t.first[2 * k] + 0.75e-3 * (u[2 * k] - t.first[2 * k]);
            work += 2e-3 * (u[2 * k + 1] - t.first[2 * k + 1]);
        }
    MUST(b, peri_get_energy(b, &e));
    CHECK_NEAR(e.external, work, 1e-7, 0);
    free(u);
    free(t.first);
    peri_body_destroy(b);
}

/* "A step without equilibrium is halved, up to `halvings` times, and grows again": all of the load comes within a tenth
   of the way. */
static int32_t early(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)points;
    for (k = 0; k < count; ++k) value[2 * k + 1] = *(const double *)user * fmin(time, 0.1) * 10;
    return 0;
}
static void halved_steps_grow_again(void) {
    double force = 0.006;
    int64_t k;
    int grown = 0;
    peri_body *b = plate(PERI_LAW_BOND_BASED, 20, 4, PERI_GEOMETRY_NONLINEAR, PERI_PRECISION_DOUBLE);
    peri_solve_desc s = settings(1e-8);
    peri_solve_report r;
    steps t;
    memset(&t, 0, sizeof t);
    MUST(b, peri_apply_body_force(b, side(b, 17, 20), NULL, early, &force));
    s.newton = 6;
    s.halvings = 12;
    s.on_step = note_step;
    s.user = &t;
    r = solve(b, &s);
    CHECK(t.count == r.steps && t.count > 3 && t.count < 14 && t.at[t.count - 1] == 1);
    for (k = 2; k < t.count; ++k) grown |= t.at[k] - t.at[k - 1] > 1.5 * (t.at[k - 1] - t.at[k - 2]);
    CHECK(grown);
    peri_body_destroy(b);
}

/* ---- what a failed solve leaves ------------------------------------------------------------------------------------- */

/* A first step that runs out of iterations can be gone on with: the factor is where the solve began, loads act with it, and the way on is
   as long as it was. */
static void failed_solves_can_be_gone_on_with(void) {
    const double force[2] = {0, 2e-3};
    double time = -1, *f;
    peri_body *b = linear();
    peri_solve_desc s = settings(1e-10);
    peri_solve_report r;
    steps t;
    memset(&t, 0, sizeof t);
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), NULL, note_time, &time));
    s.load_to = 0.25;
    (void)solve(b, &s);
    s.load_from = 0.5;
    s.load_to = 1;
    s.steps = 2;
    s.iterations = 1;
    s.preconditioner = PERI_PRECONDITIONER_BLOCK_JACOBI;
    REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &s, &r));
    CHECK(peri_load_factor(b) == 0.5 && r.steps == 0);
    time = -1;
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK(time == 0.5);
    free(f);
    s.load_from = (double)NAN;
    s.iterations = 20000;
    s.on_step = note_step;
    s.user = &t;
    (void)solve(b, &s);
    CHECK(t.count == 2 && t.at[0] == 0.75 && t.at[1] == 1);
    peri_body_destroy(b);
}

/* "iterations: most for one equilibrium": a body that breaks in many rounds may take more in all. */
static void iterations_are_of_each_round(void) {
    int64_t all = 0;
    int k;
    for (k = 0; k < 2; ++k) {
        const double move[2] = {0.6, 0}, from[2] = {6, -1}, to[2] = {6, 1.5};
        specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0.3, 1, 2.2, 12, 8, 1);
        peri_solve_desc s = settings(1e-6);
        peri_solve_report r;
        p.desc.geometry = PERI_GEOMETRY_LINEAR;
        p.material.critical_stretch = 0.08;
        peri_body *b = specimen_make(&p);
        MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
        MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
        MUST(b, peri_prescribe_displacement(b, side(b, 9, 12), PERI_AXIS_XY, move, NULL, NULL));
        s.criticality = 1;
        if (k) s.iterations = all / 2;
        r = solve(b, &s);
        if (!k) all = r.iterations;
        CHECK(r.broken > 8 && r.iterations == all && r.newton > 6);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(default_tolerances);
    RUN(removed_obstacles_are_none);
    RUN(bars_come_to_rest_on_the_ground);
    RUN(stopped_solves);
    RUN(out_of_reach_ends);
    RUN(turned_bodies_are_at_rest);
    RUN(small_loads);
    RUN(relaxation_heeds_supports);
    RUN(energy_is_of_each_equilibrium);
    RUN(energy_of_nonlinear_bodies);
    RUN(steps_that_do_nothing);
    RUN(supports_taken_away);
    RUN(work_of_a_second_load);
    RUN(halved_steps_grow_again);
    RUN(failed_solves_can_be_gone_on_with);
    RUN(iterations_are_of_each_round);
    return test_end("test_survivors_steps");
}
