/* SPDX-License-Identifier: MIT */
/* test_survivors_state.c - what `make mutants` found that no other quick test looked at: what a reset forgets, what a clone has, what
   supports and obstacles do and tell, cuts.

   SOURCE OF TRUTH: peri.h and docs/manual.md; after peri_reset and in a clone a run is that of a body that was never touched; Newton's
   second law for the whole body; energy; work of a constant motion against damping. */
#include "scene.h"

static double total(const double *x, int64_t n, int dim, int d) {
    double sum = 0;
    int64_t i;
    for (i = 0; i < n; ++i) sum += x[i * dim + d];
    return sum;
}

/* A plane block as of block(), which breaks at `stretch`. */
static peri_body *brittle(int32_t precision, int nx, int ny, double stretch) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, H, 3, nx, ny, 1);
    s.desc.precision = precision;
    s.material.critical_stretch = stretch;
    return specimen_make(&s);
}

/* The points with x <= edge. */
static int32_t left_of(peri_body *b, double edge) {
    const double lo[3] = {-100, -100, -100}, hi[3] = {edge, 100, 100};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* ---- reset --------------------------------------------------------------------------------------------------------- */

/* Stretches the body by e along x at once and takes two short steps. */
static int64_t broken_at(peri_body *b, double e) {
    const int64_t n = peri_point_count(b);
    double *x = get(b, PERI_FIELD_POSITION), *u = (double *)calloc((size_t)(2 * n), sizeof *u);
    int64_t i;
    for (i = 0; i < n; ++i) u[2 * i] = e * x[2 * i];
    put(b, PERI_FIELD_DISPLACEMENT, u);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 1e-3 * peri_stable_step(b), 0);
    free(x);
    free(u);
    return peri_broken_count(b);
}

static int64_t broken_in_clone(const peri_body *b, double e) {
    peri_body *copy = NULL;
    MUST(b, peri_body_clone(b, &copy, NULL));
    const int64_t broken = broken_at(copy, e);
    peri_body_destroy(copy);
    return broken;
}

/* Work on bonds begins anew: what was stretched by 0.9 of what breaks it may be stretched so again, and breaks at 1.2. */
static void work_begins_anew(void) {
    double least = 1e-4, most = 1;
    int k;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, 0.3, H, 3, 8, 8, 1);
    s.material.fracture_energy = 1e-4;
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s), *used = NULL;
    CHECK(broken_in_clone(b, least) == 0 && broken_in_clone(b, most) > 0);
    for (k = 0; k < 20; ++k) {
        const double e = sqrt(least * most);
        if (broken_in_clone(b, e) > 0) most = e;
        else least = e;
    }
    MUST(b, peri_body_clone(b, &used, NULL));
    CHECK(broken_at(used, 0.9 * least) == 0);
    MUST(used, peri_reset(used));
    CHECK(broken_at(used, 0.9 * least) == 0);
    MUST(used, peri_reset(used));
    CHECK(broken_at(used, 1.2 * most) == broken_in_clone(b, 1.2 * most));
    peri_body_destroy(used);
    peri_body_destroy(b);
}

/* A view of a stored field shows the present state; supports carry nothing after a reset. */
static void a_reset_is_seen(void) {
    const double v[3] = {0.01, 0, 0};
    double force[3] = {0, 0, 0};
    peri_view view;
    int64_t k;
    int moved = 0, left = 0;
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    const int32_t support = (int32_t)MUST(b, peri_prescribe_displacement(b, left_of(b, 0.3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 5, 0, 0);
    MUST(b, peri_get_reaction(b, support, force));
    CHECK(force[0] < 0);
    MUST(b, peri_view_field(b, PERI_FIELD_FORCE_DENSITY, &view));
    const double *f = (const double *)view.data;
    for (k = 0; k < view.count; ++k) moved |= f[k * view.point_stride] != 0;
    MUST(b, peri_reset(b));
    for (k = 0; k < view.count; ++k) left |= f[k * view.point_stride] != 0 || f[k * view.point_stride + view.component_stride] != 0;
    CHECK(moved && !left);
    MUST(b, peri_get_reaction(b, support, force));
    CHECK(force[0] == 0 && force[1] == 0);
    peri_body_destroy(b);
}

static int32_t stop_at_once(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)time, (void)count, (void)points, (void)value;
    return 1;
}

/* Energy that is put in twice, with a run that stops before its first step in between, is counted once. */
static void energy_is_put_in_once(void) {
    const double v[3] = {0.1, 0, 0}, none[3] = {0, 0, 0};
    peri_advance_desc r;
    peri_energy e;
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    const double mass = DENSITY * 0.8 * 0.4 * THICK;
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    MUST(b, peri_get_energy(b, &e));
    CHECK_NEAR(e.initial, 0.5 * mass * 0.01, 1e-12, 0);
    const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, none, stop_at_once, NULL));
    peri_advance_desc_init(&r);
    r.steps = 1;
    CHECK(peri_advance(b, &r) == PERI_STOPPED && peri_step_count(b) == 0);
    MUST(b, peri_remove_load(b, load));
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    MUST(b, peri_get_energy(b, &e));
    CHECK_NEAR(e.initial, 0.5 * mass * 0.04, 1e-12, 0);
    peri_body_destroy(b);
}

/* ---- clones -------------------------------------------------------------------------------------------------------- */

static int32_t clone_in_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    peri_error e;
    peri_body *copy = (peri_body *)user;
    (void)time, (void)count, (void)points, (void)value;
    CHECK(peri_body_clone((peri_body *)user, &copy, &e) == PERI_ERROR_ORDER && copy == NULL && e.code == PERI_ERROR_ORDER);
    return 0;
}

/* What a clone tells of its past, and that none is made within a step. */
static void clones_know_the_past(void) {
    const double v[3] = {0.01, 0, 0}, pull[3] = {0.1, 0, 0}, none[3] = {0, 0, 0};
    double own[3] = {0, 0, 0}, its[3] = {1, 1, 1};
    peri_solve_desc d;
    peri_body *copy = NULL, *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    CHECK(peri_load_factor(b) == 0);
    const int32_t support = (int32_t)MUST(b, peri_prescribe_displacement(b, left_of(b, 0.3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 5, 0, 0);
    MUST(b, peri_body_clone(b, &copy, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL)); /* acts from the next step on: the last one is told of */
    MUST(copy, peri_apply_body_force(copy, PERI_ALL, pull, NULL, NULL));
    MUST(b, peri_get_reaction(b, support, own));
    MUST(copy, peri_get_reaction(copy, support, its));
    CHECK(own[0] < 0 && own[0] == its[0] && own[1] == its[1]);
    peri_body_destroy(copy);
    MUST(b, peri_reset(b));
    CHECK(peri_load_factor(b) == 0);
    peri_solve_desc_init(&d);
    d.load_to = 0.5;
    MUST(b, peri_solve(b, &d, NULL));
    MUST(b, peri_body_clone(b, &copy, NULL));
    CHECK(peri_load_factor(b) == 0.5 && peri_load_factor(copy) == 0.5);
    peri_body_destroy(copy);
    MUST(b, peri_reset(b));
    MUST(b, peri_apply_body_force(b, PERI_ALL, none, clone_in_load, b));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0, 0);
    peri_body_destroy(b);
}

/* Bonds between two materials are what was asked for in a clone, too. */
static void clones_know_interfaces(void) {
    const double lo[2] = {0, 0}, middle[2] = {0.4, 0.4}, hi[2] = {0.8, 0.4}, right[2] = {0.4, 0};
    double own = 0, its = 0, without = 0;
    peri_material_desc m;
    peri_body *copy = NULL, *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 0.3);
    const int32_t first = unbreakable(b, 1, 1), second = unbreakable(b, 2, 1);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 5;
    MUST(b, peri_get_bond_constants(b, first, second, &without, NULL));
    MUST(b, peri_set_interface(b, first, second, &m));
    MUST(b, peri_add_box(b, first, lo, middle, H));
    MUST(b, peri_add_box(b, second, right, hi, H));
    MUST(b, peri_build(b));
    MUST(b, peri_body_clone(b, &copy, NULL));
    MUST(b, peri_get_bond_constants(b, first, second, &own, NULL));
    MUST(copy, peri_get_bond_constants(copy, first, second, &its, NULL));
    CHECK(own == its && own > 2 * without);
    peri_body_destroy(copy);
    peri_body_destroy(b);
}

/* ---- supports ------------------------------------------------------------------------------------------------------ */

/* At one velocity the support of the whole body does work against damping alone: force density a rho v. The load factor is not for
   velocities. */
static void steady_motion_costs_damping(void) {
    const double v[3] = {0.02, -0.01, 0}, a = 3;
    double force[3] = {0, 0, 0};
    peri_advance_desc r;
    int64_t i;
    int d, bad = 0;
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    const int32_t support = (int32_t)MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_XY, v, NULL, NULL));
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    peri_advance_desc_init(&r);
    r.steps = 3;
    r.damping = a;
    r.load_factor = 0.5;
    MUST(b, peri_advance(b, &r));
    MUST(b, peri_get_reaction(b, support, force));
    for (d = 0; d < 2; ++d) CHECK_NEAR(force[d], a * DENSITY * v[d] * (0.8 * 0.4 * THICK), 1e-9, 0);
    double *speed = get(b, PERI_FIELD_VELOCITY);
    for (i = 0; i < peri_point_count(b); ++i)
        for (d = 0; d < 2; ++d) bad += fabs(speed[2 * i + d] - v[d]) > 1e-12 * fabs(v[d]);
    CHECK(bad == 0);
    free(speed);
    peri_body_destroy(b);
}

/* Momentum at the end of a step less that before is the step times the reaction, in steps in which bonds break, too. */
static void reactions_are_momentum(void) {
    const double v[3] = {0.3, 0.05, 0};
    int64_t broken = 0;
    int step, seen_breaks = 0, d;
    peri_body *b = brittle(PERI_PRECISION_DOUBLE, 10, 5, 0.02);
    const int32_t support = (int32_t)MUST(b, peri_prescribe_displacement(b, left_of(b, 0.3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0.01, 0);
    for (step = 0; step < 60; ++step) {
        double before[3], after[3], force[3];
        MUST(b, peri_get_momentum(b, before, NULL));
        (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0.01, 0);
        MUST(b, peri_get_momentum(b, after, NULL));
        MUST(b, peri_get_reaction(b, support, force));
        for (d = 0; d < 2; ++d) CHECK_NEAR(0.01 * force[d], after[d] - before[d], 0, 1e-13);
        seen_breaks += peri_broken_count(b) > broken;
        broken = peri_broken_count(b);
    }
    CHECK(seen_breaks > 3);
    peri_body_destroy(b);
}

/* Later supports win; one that goes gives back what it took, and one that owns nothing carries nothing. */
static void supports_take_and_give_back(void) {
    const double v[3] = {0.02, 0, 0}, w[3] = {-0.03, 0, 0};
    double force[3] = {0, 0, 0};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    const int32_t first = (int32_t)MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, v, NULL, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0, 0);
    MUST(b, peri_get_reaction(b, first, force));
    CHECK(force[0] > 0);
    const int32_t second = (int32_t)MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, w, NULL, NULL));
    MUST(b, peri_get_reaction(b, first, force));
    CHECK(force[0] == 0 && force[1] == 0);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0, 0);
    double *speed = get(b, PERI_FIELD_VELOCITY);
    CHECK_NEAR(speed[0], w[0], 1e-12, 0);
    free(speed);
    MUST(b, peri_remove_load(b, second));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0, 0);
    speed = get(b, PERI_FIELD_VELOCITY);
    CHECK_NEAR(speed[0], v[0], 1e-12, 0);
    free(speed);
    peri_body_destroy(b);
}

/* A displacement that single precision cannot hold is reached as near as it can, and then kept: nothing moves any more. */
static void single_supports_come_to_rest(void) {
    const double to[3] = {0.1 / 3, 0.01 / 7, 0};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_SINGLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    peri_energy e;
    MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, to, NULL, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0, 0);
    MUST(b, peri_get_energy(b, &e));
    CHECK(e.kinetic == 0);
    peri_body_destroy(b);
}

/* ---- obstacles ----------------------------------------------------------------------------------------------------- */

typedef struct mover {
    double start[2], shift;
    int    calls, wrong;
} mover;

static int32_t move(void *user, double time, double *place, double *turn) {
    (void)turn;
    mover *m = (mover *)user;
    (void)time;
    m->calls++;
    m->wrong += fabs(place[0] - m->start[0]) > 1e-12 || fabs(place[1] - m->start[1]) > 1e-12;
    place[1] += m->shift;
    return 0;
}

/* A motion finds the place at which the obstacle was added, and its force is that of where it is now: stiffness*depth on every point. */
static void obstacles_are_where_they_are(void) {
    const double place[3] = {0, -1, 0}, up[3] = {0, 1, 0}, none[3] = {0, 0, 0};
    mover m = {{0, -1}, 1 + H, 0, 0};
    double force[3] = {0, 0, 0};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    const int32_t obstacle = (int32_t)MUST(b, plane_obstacle(b, place, up, 2, move, &m));
    MUST(b, peri_get_obstacle_force(b, obstacle, force, NULL)); /* up to y = H: the row at H/2 is H/2 deep */
    CHECK_NEAR(force[1], 2 * (0.5 * H) * 8 * H * H * THICK, 1e-12, 0);
    MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, none, NULL, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0, 0);
    MUST(b, peri_get_obstacle_force(b, obstacle, force, NULL));
    CHECK_NEAR(force[1], 2 * (0.5 * H) * 8 * H * H * THICK, 1e-12, 0);
    CHECK(m.calls >= 4 && m.wrong == 0);
    peri_body_destroy(b);
}

/* Cells of another size than that of the first box fall on a plane: what they lose it has taken. */
static void obstacles_do_their_work(void) {
    const double far[2] = {10, 10}, farther[2] = {10.4, 10.4}, lo[2] = {0, 0}, hi[2] = {0.4, 0.2}, down[2] = {0, -0.4}, up[2] = {0, 1};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 0.3);
    const int32_t glass = unbreakable(b, YOUNG, DENSITY);
    peri_energy e;
    MUST(b, peri_add_box(b, glass, far, farther, 0.1));
    MUST(b, peri_add_box(b, glass, lo, hi, 0.05));
    MUST(b, peri_build(b));
    MUST(b, peri_add_velocity(b, PERI_ALL, down));
    MUST(b, plane_obstacle(b, lo, up, 5, NULL, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 100, 0.001, 0);
    MUST(b, peri_get_energy(b, &e));
    CHECK(e.obstacle < 0);
    CHECK(fabs(e.error) < 0.01 * fabs(e.obstacle));
    peri_body_destroy(b);
}

/* ---- cuts ---------------------------------------------------------------------------------------------------------- */

/* Where the body is now: as many bonds as at the same place of the body at rest. */
static void cuts_in_place(void) {
    const double from[2] = {0.4, -1}, to[2] = {0.4, 2}, shift[2] = {0.37, 0}, there[2] = {0.77, -1}, thither[2] = {0.77, 2};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    const int64_t cut = MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to));
    CHECK(cut > 0 && peri_cut_count(b) == 0 && peri_broken_count(b) == cut);
    MUST(b, peri_reset(b));
    MUST(b, peri_add_displacement(b, PERI_ALL, shift));
    CHECK(peri_cut_segment(b, PERI_CUT_IN_PLACE, there, thither) == cut);
    CHECK(peri_cut_count(b) == 0);
    peri_body_destroy(b);
}

static int32_t count_pairs(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)i, (void)j, (void)xi, (void)xj;
    ++*(int64_t *)user;
    return 0;
}

/* Bonds cut later are whole after a reset, those of the initial crack are not; a predicate sees what is whole. */
static void later_cuts_heal(void) {
    const double from[2] = {0.4, -1}, to[2] = {0.4, 0.2}, end[2] = {0.4, 2};
    int64_t asked = 0;
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 8, 4, 1);
    const int64_t first = MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    double *before = get(b, PERI_FIELD_DAMAGE);
    CHECK(first > 0 && peri_cut_count(b) == first && peri_broken_count(b) == 0);
    const int64_t later = MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, end));
    CHECK(later > 0 && peri_cut_count(b) == first && peri_broken_count(b) == later);
    CHECK(peri_cut_if(b, PERI_CUT_NOW, count_pairs, &asked) == 0);
    CHECK(asked == peri_bond_count(b) - first - later);
    MUST(b, peri_reset(b));
    double *after = get(b, PERI_FIELD_DAMAGE);
    CHECK(memcmp(before, after, (size_t)peri_point_count(b) * sizeof *before) == 0);
    asked = 0;
    CHECK(peri_cut_if(b, PERI_CUT_NOW, count_pairs, &asked) == 0);
    CHECK(asked == peri_bond_count(b) - first);
    free(before);
    free(after);
    peri_body_destroy(b);
}

/* A zone that is switched off again is none. */
static void zones_end(void) {
    peri_body *b = brittle(PERI_PRECISION_DOUBLE, 8, 4, 0.02), *copy = NULL;
    MUST(b, peri_body_clone(b, &copy, NULL));
    MUST(b, peri_set_no_fail(b, PERI_ALL, 1));
    CHECK(broken_in_clone(b, 0.1) == 0);
    MUST(b, peri_set_no_fail(b, PERI_ALL, 0));
    const int64_t broken = broken_at(copy, 0.1);
    CHECK(broken > 0 && broken_at(b, 0.1) == broken);
    peri_body_destroy(copy);
    peri_body_destroy(b);
}

/* ---- stress -------------------------------------------------------------------------------------------------------- */

/* A chain of points along x, stretched by l: E_xx = (l^2 - 1)/2, S = (lambda + 2 mu) E_xx, sigma = l S: its width stays. Pressed onto one
   line all is finite. */
static void stress_of_thin_families(void) {
    const moduli m = moduli_of(PERI_SPACE_PLANE_STRAIN, 0.3);
    const double l = 1.25;
    double u[16] = {0};
    int k, bad = 0;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_CORRESPONDENCE, 0.3, H, 3, 8, 1, 1);
    s.material.young = YOUNG;
    peri_body *b = specimen_make(&s);
    for (k = 0; k < 8; ++k) u[2 * k] = (l - 1) * k * H;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    double *stress = get(b, PERI_FIELD_STRESS);
    for (k = 0; k < 8; ++k) {
        CHECK_NEAR(stress[3 * k], l * (m.lambda + 2 * m.mu) * 0.5 * (l * l - 1), 1e-12, 0);
    }
    free(stress);
    peri_body_destroy(b);
    s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_CORRESPONDENCE, 0.3, H, 3, 4, 4, 1);
    b = specimen_make(&s);
    double *x = get(b, PERI_FIELD_POSITION);
    for (k = 0; k < 16; ++k) x[2 * k] = -x[2 * k], x[2 * k + 1] = 0;
    put(b, PERI_FIELD_DISPLACEMENT, x);
    stress = get(b, PERI_FIELD_STRESS);
    for (k = 0; k < 48; ++k) bad += !(fabs(stress[k]) < HUGE_VAL);
    CHECK(bad == 0);
    free(stress);
    free(x);
    peri_body_destroy(b);
}

/* theta of whole cells and w = 1 as docs/theory.md has it: of LPS (D/m) sum |xi| e V, of Oterkus D sum e V/sum |xi| V; of bonds as LPS with
   w/|xi|, which is the same. */
static void dilatation_of_any_motion(void) {
    const int32_t laws[3] = {PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_BOND_BASED};
    int law, bad;
    int64_t i, j;
    for (law = 0; law < 3; ++law) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, laws[law], 0.3, H, 3, 7, 6, 1);
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        peri_body *b = specimen_make(&s);
        const int64_t n = peri_point_count(b);
        double *x = get(b, PERI_FIELD_POSITION), *u = random_field(2 * n, 0.01, 5), *theta;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        theta = get(b, PERI_FIELD_DILATATION);
        for (i = bad = 0; i < n; ++i) {
            double sum = 0, whole = 0;
            for (j = 0; j < n; ++j) {
                const double dx = x[2 * j] - x[2 * i], dy = x[2 * j + 1] - x[2 * i + 1], bond = sqrt(dx * dx + dy * dy);
                const double e = (dx * (u[2 * j] - u[2 * i]) + dy * (u[2 * j + 1] - u[2 * i + 1])) / (i == j ? 1 : bond);
                if (i == j || bond > 3.001 * H) continue;
                sum += law == 0 ? bond * e : e;
                whole += law == 0 ? bond * bond : bond;
            }
            bad += fabs(theta[i] - 2 * sum / whole) > 1e-10;
        }
        CHECK(bad == 0);
        CHECK(fabs(total(theta, n, 1, 0)) > 1e-6);
        free(x);
        free(u);
        free(theta);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(work_begins_anew);
    RUN(a_reset_is_seen);
    RUN(energy_is_put_in_once);
    RUN(clones_know_the_past);
    RUN(clones_know_interfaces);
    RUN(steady_motion_costs_damping);
    RUN(reactions_are_momentum);
    RUN(supports_take_and_give_back);
    RUN(single_supports_come_to_rest);
    RUN(obstacles_are_where_they_are);
    RUN(obstacles_do_their_work);
    RUN(cuts_in_place);
    RUN(later_cuts_heal);
    RUN(zones_end);
    RUN(stress_of_thin_families);
    RUN(dilatation_of_any_motion);
    return test_end("test_survivors_state");
}
