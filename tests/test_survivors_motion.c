/* SPDX-License-Identifier: MIT */
/* test_survivors_motion.c - what `make mutants` found that no other test of runs looked at: ends of runs, frames, factors, limits.

   SOURCE OF TRUTH: peri.h and docs/manual.md; Newton's second law for bodies that move as one. */
#include "refusal.h"

static int32_t count_frames(void *user, peri_body *b) {
    (void)b;
    ++*(int *)user;
    return 0;
}

/* A body that moves at v is v*duration further on, however the duration is cut into steps; and the run tells of its end. */
static void durations_are_run_through(void) {
    static const double parts[5] = {0.3, 1, 1.4, 2.5, 7.01};
    int k, central;
    for (k = 0; k < 5; ++k)
        for (central = 0; central < 2; ++central) {
            const double v[2] = {1, -2};
            peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
            peri_advance_desc r;
            int frames = 0;
            MUST(b, peri_add_velocity(b, PERI_ALL, v));
            peri_advance_desc_init(&r);
            r.time_step = 0.5 * peri_stable_step(b);
            r.duration = parts[k] * r.time_step;
            r.integrator = central ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET;
            r.on_frame = count_frames;
            r.user = &frames;
            MUST(b, peri_advance(b, &r));
            double *u = get(b, PERI_FIELD_DISPLACEMENT);
            CHECK_NEAR(u[0], v[0] * r.duration, 1e-12, 0);
            CHECK_NEAR(u[31], v[1] * r.duration, 1e-12, 0);
            CHECK(peri_time(b) == r.duration && peri_step_count(b) == (int64_t)ceil(parts[k]));
            CHECK(frames == 1); /* frame_steps 0: only at the end */
            r.duration = 0;
            r.steps = 7;
            r.frame_steps = 3;
            frames = 0;
            MUST(b, peri_advance(b, &r));
            CHECK(frames == 3); /* after 3, 6 and 7 */
            free(u);
            peri_body_destroy(b);
        }
}

static int32_t stop_third(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)time;
    (void)count;
    (void)points;
    (void)value;
    return ++*(int *)user >= 3;
}

/* "at the end of a run": of one that a load stops, too. */
static void a_stopped_run_shows_its_end(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    peri_advance_desc r;
    int frames = 0, calls = -1; /* one call is for the force at the start */
    MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, stop_third, &calls));
    peri_advance_desc_init(&r);
    r.steps = 10;
    r.on_frame = count_frames;
    r.user = &frames;
    CHECK(peri_advance(b, &r) == PERI_STOPPED);
    CHECK(peri_step_count(b) == 3 && frames == 1);
    peri_body_destroy(b);
}

/* Under a uniform force per mass a free body is accelerated as one, by the factor from the first half kick on. */
static void factors_act_from_the_start(void) {
    const double force[2] = {4, 0}; /* twice the density: acceleration 2 */
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    peri_advance_desc r;
    MUST(b, peri_apply_body_force(b, PERI_ALL, force, NULL, NULL));
    peri_advance_desc_init(&r);
    r.time_step = 0.5 * peri_stable_step(b);
    r.steps = 1;
    const double gain = 2 * r.time_step;
    MUST(b, peri_advance(b, &r));
    double *v = get(b, PERI_FIELD_VELOCITY);
    CHECK_NEAR(v[0], gain, 1e-12, 0);
    free(v);
    r.load_factor = 3;
    MUST(b, peri_advance(b, &r));
    v = get(b, PERI_FIELD_VELOCITY);
    CHECK_NEAR(v[0], 4 * gain, 1e-12, 0);
    CHECK(peri_load_factor(b) == 3);
    free(v);
    peri_body_destroy(b);
}

typedef struct times {
    double asked[64];
    int count;
} times;

static int32_t by_time(void *user, double time, int64_t count, const int32_t *points, double *value) {
    times *t = (times *)user;
    int64_t k;
    (void)points;
    if (t->count < 64) t->asked[t->count++] = time;
    for (k = 0; k < count; ++k) value[2 * k] = 1 + 2 * time;
    return 0;
}

/* In peri_solve callbacks are asked for load factors, in peri_advance for times: a run after a solve begins at its own time. */
static void runs_after_solves_have_their_time(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 6, 6, 1);
    const double lo[2] = {-1, -1}, hi[2] = {0.25, 1};
    peri_solve_desc s;
    peri_advance_desc r;
    times t = {{0}, 0};
    int k;
    const int32_t grip = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    MUST(b, peri_prescribe_displacement(b, grip, PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, by_time, &t));
    peri_solve_desc_init(&s);
    s.load_to = 0.75;
    MUST(b, peri_solve(b, &s, NULL));
    CHECK(t.count > 0 && t.asked[t.count - 1] == 0.75);
    t.count = 0;
    peri_advance_desc_init(&r);
    r.steps = 2;
    r.time_step = 0.5 * peri_stable_step(b);
    r.load_factor = 0.75; /* no other factor than that of the solve */
    MUST(b, peri_advance(b, &r));
    for (k = 0; k < t.count; ++k) CHECK(fabs(t.asked[k] - k * r.time_step) < 1e-12);
    CHECK(t.count == 3); /* the start, and the end of each step */
    peri_body_destroy(b);
}

/* What an obstacle does to the stable step goes with it. */
static void removed_obstacles_cost_no_step(void) {
    const double place[2] = {0, -1}, up[2] = {0, 1};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    const double before = peri_stable_step(b);
    const int32_t wall = (int32_t)MUST(b, plane_obstacle(b, place, up, 0, NULL, NULL));
    CHECK(peri_stable_step(b) < before);
    MUST(b, peri_remove_obstacle(b, wall));
    CHECK(peri_stable_step(b) == before);
    peri_body_destroy(b);
}

/* Damping that takes more than all in a step is refused; a speed beyond 1e9 of sound ends the run at its first point, also where only the
   last half kick of a central difference leads there: from rest to 1.4e9 by way of 0.7e9. */
static void runs_have_limits(void) {
    int central;
    for (central = 0; central < 2; ++central) {
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
        peri_advance_desc r;
        peri_advance_desc_init(&r);
        r.integrator = central ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET;
        r.steps = 1;
        r.time_step = 0.5 * peri_stable_step(b);
        r.damping = 2.5 / r.time_step;
        REFUSE(b, PERI_ERROR_RANGE, peri_advance(b, &r));
        CHECK(strcmp(seen.field, "damping") == 0 && seen.value == r.damping);
        r.damping = 0;
        const double push[2] = {1.4e9 * sqrt(YOUNG / DENSITY) * DENSITY / r.time_step, 0};
        MUST(b, peri_apply_body_force(b, PERI_ALL, push, NULL, NULL));
        REFUSE(b, PERI_ERROR_UNSTABLE, peri_advance(b, &r));
        CHECK(seen.index == 0);
        peri_body_destroy(b);
    }
}

/* A set is of points in their order, whatever order they were given in; forces of a load on some points are those of their volumes. */
static void loads_know_their_points(void) {
    const double x[8] = {0, 0, 1, 0, 2, 0, 3, 0}, volume[4] = {1, 2, 4, 8}, force[2] = {0, 3};
    const int32_t some[2] = {3, 1};
    double total[2] = {0, 0};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 4, x, volume, NULL));
    MUST(b, peri_build(b));
    const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, 2, some));
    const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, set, force, NULL, NULL));
    MUST(b, peri_get_reaction(b, load, total));
    CHECK_NEAR(total[1], 3 * (2 + 8) * THICK, 1e-14, 0);
    CHECK(total[0] == 0);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(durations_are_run_through);
    RUN(a_stopped_run_shows_its_end);
    RUN(factors_act_from_the_start);
    RUN(runs_after_solves_have_their_time);
    RUN(removed_obstacles_cost_no_step);
    RUN(runs_have_limits);
    RUN(loads_know_their_points);
    return test_end("test_survivors_motion");
}
