/* SPDX-License-Identifier: MIT */
/* test_survivors_calls.c - what `make mutants` found that no other test looked at: calls from callbacks, obstacles, supports, units.

   SOURCE OF TRUTH: peri.h and docs/manual.md: what a callback may do, what an obstacle and a support do, what is told to the log; sums
   written out over the points; identities between laws (at the Poisson ratio of central springs A is 0, and LPS couples a point with its
   family alone). */
#include "refusal.h"

/* ---- calls from callbacks ------------------------------------------------------------------------------------------ */

typedef struct caller {
    peri_body *body;
    int calls;
    int64_t said;
} caller;

static int32_t meddle(void *user, double time, int64_t count, const int32_t *points, double *value) {
    static const double force[3] = {1, 1, 1};
    caller *c = (caller *)user;
    (void)time;
    (void)count;
    (void)points;
    (void)value;
    c->calls++;
    c->said = peri_apply_body_force(c->body, PERI_ALL, force, NULL, NULL);
    return 0;
}

/* A load is no peri_frame_fn: it may change nothing, whether a step asks it or somebody who reads forces. */
static void loads_change_nothing(void) {
    int stepping;
    for (stepping = 0; stepping < 2; ++stepping) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
        caller c = {b, 0, 0};
        double f[32];
        const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, meddle, &c));
        if (stepping) MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0, 0));
        else MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 32));
        CHECK(c.calls > 0 && c.said == PERI_ERROR_ORDER);
        CHECK(PERI_ID_INDEX(peri_apply_body_force(b, PERI_ALL, NULL, meddle, &c)) == PERI_ID_INDEX(load) + 1); /* none came between */
        peri_body_destroy(b);
    }
}

static caller hooked;

static void serial(void *user, int64_t count, peri_task_fn task, void *context) {
    static const double force[3] = {1, 1, 1};
    int64_t k;
    (void)user;
    hooked.calls++;
    if (hooked.body) hooked.said = peri_apply_body_force(hooked.body, PERI_ALL, force, NULL, NULL);
    for (k = count - 1; k >= 0; --k) task(context, k);
}

/* A job system does the loops of a body that is large enough, in any order, and changes nothing. */
static void job_systems_are_used(void) {
    double *u[2];
    int k;
    for (k = 0; k < 2; ++k) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.1, 90, 60, 1);
        const double force[2] = {1e-3, 2e-3};
        const int32_t some[2] = {5, 77};
        hooked.body = NULL;
        hooked.calls = 0;
        hooked.said = 0;
        if (k) s.desc.parallel_for = serial;
        peri_body *b = specimen_make(&s);
        if (k) hooked.body = b;
        MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 2, some)), force, NULL, NULL));
        u[k] = get(b, PERI_FIELD_FORCE_DENSITY);
        CHECK(k ? hooked.calls > 0 && hooked.said == PERI_ERROR_ORDER : hooked.calls == 0);
        free(u[k]);
        hooked.body = NULL;
        MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 3, 0, 0));
        u[k] = get(b, PERI_FIELD_DISPLACEMENT);
        peri_body_destroy(b);
    }
    CHECK(memcmp(u[0], u[1], 2 * 90 * 60 * sizeof *u[0]) == 0 && largest(u[0], 10800) > 0);
    free(u[0]);
    free(u[1]);
}

static void log_and_destroy(void *user, int32_t level, const char *text) {
    caller *c = (caller *)user;
    (void)level;
    (void)text;
    c->calls++;
    if (c->body && c->calls < 100) peri_body_destroy(c->body); /* ignored, and nothing is said of it to the log itself */
}

static void logs_are_not_told_of_themselves(void) {
    const double from[2] = {50, 0}, to[2] = {51, 0};
    caller c = {NULL, 0, 0};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 4, 4, 1);
    s.desc.log = log_and_destroy;
    s.desc.log_user = &c;
    peri_body *b = specimen_make(&s);
    c.body = b;
    CHECK(peri_cut_segment(b, PERI_CUT_NOW, from, to) == 0); /* meets no bond: a remark */
    CHECK(c.calls == 1 && peri_point_count(b) == 16);
    c.body = NULL;
    peri_body_destroy(b);
}

/* Oterkus's spring is held back where its energy could be negative: at Poisson ratios near -1, not at usual ones; the log is told. */
static void soft_springs_are_told(void) {
    static const double nu[2] = {0.3, -0.95};
    int k;
    for (k = 0; k < 2; ++k) {
        caller c = {NULL, 0, 0};
        specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_OTERKUS, nu[k], 1, 2.2, 5, 5, 5);
        s.desc.log = log_and_destroy;
        s.desc.log_user = &c;
        peri_body_destroy(specimen_make(&s));
        CHECK(c.calls == k);
    }
}

static int32_t part(void *user, peri_body *b) {
    static const int32_t pair[2] = {0, 1};
    double *f = (double *)user;
    CHECK(peri_cut_pairs(b, PERI_CUT_NOW, 1, pair) == 1);
    CHECK(peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 4) == PERI_OK);
    return 1;
}

/* on_frame may cut and read: the force is that of the bonds that are left, and its wish to stop is heeded. */
static void frames_read_what_they_have_done(void) {
    const double x[4] = {0, 0, 1, 0}, volumes[2] = {1, 1}, pull[2] = {0.01, 0};
    const int32_t right[1] = {1};
    double f[4];
    peri_advance_desc r;
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 1.5);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 2, x, volumes, NULL));
    MUST(b, peri_build(b));
    MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, right)), pull));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 4));
    CHECK(f[0] > 0 && f[2] == -f[0]);
    peri_advance_desc_init(&r);
    r.steps = 5;
    r.frame_steps = 1;
    r.on_frame = part;
    r.user = f;
    CHECK(peri_advance(b, &r) == PERI_STOPPED && peri_step_count(b) == 1);
    CHECK(f[0] == 0 && f[2] == 0);
    peri_body_destroy(b);
}

/* ---- loads, supports, obstacles ------------------------------------------------------------------------------------ */

static void there_is_room_for_loads(void) {
    const double force[2] = {1, 0};
    double f[32];
    int k;
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    for (k = 1; k <= 40; ++k) CHECK(PERI_ID_INDEX(MUST(b, peri_apply_body_force(b, PERI_ALL, force, NULL, NULL))) == k);
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 32));
    CHECK_NEAR(f[0], 40, 1e-12, 0);
    peri_body_destroy(b);
}

/* An obstacle pushes from when it is added to when it is removed, each point by stiffness times depth times volume. */
static void obstacles_push_while_they_are_there(void) {
    const double x[6] = {0, 0.25, 1, 0.5, 2, 2}, volume[3] = {1, 2, 4}, place[2] = {0, 1}, up[2] = {0, 1};
    double f[6], force[2];
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 3);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 3, x, volume, NULL));
    MUST(b, peri_build(b));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 6));
    CHECK(largest(f, 6) == 0);
    const int32_t wall = (int32_t)MUST(b, plane_obstacle(b, place, up, 8, NULL, NULL));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 6));
    CHECK_NEAR(f[1], 8 * 0.75, 1e-12, 0);
    CHECK_NEAR(f[3], 8 * 0.5, 1e-12, 0);
    CHECK(f[5] == 0);
    MUST(b, peri_get_obstacle_force(b, wall, force, NULL));
    CHECK_NEAR(force[1], 8 * (0.75 * 1 + 0.5 * 2) * THICK, 1e-12, 0);
    MUST(b, peri_remove_obstacle(b, wall));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 6));
    CHECK(largest(f, 6) == 0);
    peri_body_destroy(b);
}

/* A component belongs to the last support that prescribes it, and so does the force on it. */
static void reactions_are_of_their_support(void) {
    const double force[2] = {3, 5};
    double first[2], second[2];
    peri_solve_desc s;
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    const int32_t both = (int32_t)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, NULL, NULL));
    const int32_t across = (int32_t)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_Y, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, force, NULL, NULL));
    peri_solve_desc_init(&s);
    MUST(b, peri_solve(b, &s, NULL));
    const double volume = 16 * H * H * THICK;
    MUST(b, peri_get_reaction(b, both, first));
    MUST(b, peri_get_reaction(b, across, second));
    CHECK_NEAR(first[0], -3 * volume, 1e-12, 0);
    CHECK_NEAR(second[1], -5 * volume, 1e-12, 0);
    CHECK(first[1] == 0 && second[0] == 0);
    peri_body_destroy(b);
}

/* ---- laws ---------------------------------------------------------------------------------------------------------- */

static int64_t entries_of(int32_t law, double nu) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, nu, 1, 2.2, 9, 9, 1);
    peri_body *b = specimen_make(&s);
    peri_matrix *a = NULL;
    MUST(b, peri_matrix_create(b, &a));
    const int64_t entries = peri_matrix_entries(a);
    peri_matrix_destroy(a);
    peri_body_destroy(b);
    return entries;
}

static void central_springs_couple_families_alone(void) {
    const int64_t bonds = entries_of(PERI_LAW_BOND_BASED, 0);
    CHECK(entries_of(PERI_LAW_LPS, 1.0 / 3) == bonds);
    CHECK(entries_of(PERI_LAW_LPS, 0.3) > bonds);
}

/* Units whose products leave 1e-250 to 1e250 are refused (manual.md). */
static void units_have_a_range(void) {
    static const double young[3] = {1e255, 1e-255, 1};
    int k;
    for (k = 0; k < 3; ++k) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 4, 4, 1);
        s.material.young = young[k];
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
        if (k < 2) {
            REFUSE(b, PERI_ERROR_RANGE, peri_build(b));
            CHECK(strcmp(seen.field, "spacing, young, density") == 0);
        } else MUST(b, peri_build(b));
        peri_body_destroy(b);
    }
}

/* A body that was reset breaks as it did before, to the last bit, whatever its criterion keeps of every bond. */
static void criteria_begin_anew(void) {
    static const int32_t criteria[2] = {PERI_CRITERION_BOND_ENERGY, PERI_CRITERION_NODE_ENERGY};
    int n, kernel, turn;
    for (n = 0; n < 2; ++n)
        for (kernel = 0; kernel < 2; ++kernel) {
            specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 2.2, 10, 6, 1);
            const double lo[2] = {5, -1}, hi[2] = {11, 7}, v[2] = {0.2, 0.01};
            double *u[2];
            int64_t broken[2];
            s.material.criterion = criteria[n];
            s.material.fracture_energy = 2e-3;
            s.desc.kernel = kernel ? PERI_KERNEL_REFERENCE : PERI_KERNEL_BEST;
            peri_body *b = specimen_make(&s);
            const int32_t right = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
            for (turn = 0; turn < 2; ++turn) {
                MUST(b, peri_add_velocity(b, right, v));
                MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 12, 0.2, 0));
                u[turn] = get(b, PERI_FIELD_DISPLACEMENT);
                broken[turn] = peri_broken_count(b);
                MUST(b, peri_reset(b));
            }
            CHECK(broken[0] > 0 && broken[0] == broken[1]);
            CHECK(memcmp(u[0], u[1], 120 * sizeof(double)) == 0);
            free(u[0]);
            free(u[1]);
            peri_body_destroy(b);
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(loads_change_nothing);
    RUN(job_systems_are_used);
    RUN(logs_are_not_told_of_themselves);
    RUN(soft_springs_are_told);
    RUN(frames_read_what_they_have_done);
    RUN(there_is_room_for_loads);
    RUN(obstacles_push_while_they_are_there);
    RUN(reactions_are_of_their_support);
    RUN(central_springs_couple_families_alone);
    RUN(units_have_a_range);
    RUN(criteria_begin_anew);
    return test_end("test_survivors_calls");
}
