/* SPDX-License-Identifier: MIT */
/* test_world_calls.c - callbacks in a world, jumps out of them, failing allocations, nonsense.

   SOURCE OF TRUTH: peri.h and docs/laws.md; what fails has changed nothing; the allocator's own counts. */
#include "world_crowd.h"
#include <setjmp.h>

/* ---- callbacks --------------------------------------------------------------------------------------------------------------------- */

typedef struct visit {
    crowd  *c;
    int     calls[BODIES], refused;
    int64_t steps;
    int     stop_at;
} visit;

static int32_t look(void *user, peri_body *b) {
    visit *v = (visit *)user;
    peri_advance_desc a;
    peri_energy e;
    peri_advance_desc_init(&a);
    a.steps = 1;
    for (int k = 0; k < BODIES; ++k) v->calls[k] += v->c->body[k] == b;
    v->refused += peri_world_advance(v->c->world, &a) == PERI_ERROR_ORDER;
    v->refused += peri_world_remove(v->c->world, b) == PERI_ERROR_ORDER;
    v->refused += peri_advance(b, &a) == PERI_ERROR_ORDER;
    peri_body_destroy(b);
    peri_world_destroy(v->c->world);
    CHECK(peri_world_get_energy(v->c->world, &e) == PERI_OK);
    CHECK(fabs(e.error) < 0.01 * e.initial);
    for (int k = 0; k < BODIES; ++k) CHECK(peri_step_count(v->c->body[k]) == peri_step_count(b));
    return v->stop_at > 0 && v->calls[0] == v->stop_at && b == v->c->body[1];
}

static int32_t refuse(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)count, (void)points, (void)value;
    return time > 2e-6 ? -7 : 0;
}

static int32_t wish_to_stop(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)count, (void)points, (void)value;
    return time > *(double *)user;
}

static void callbacks_are_heeded(void) {
    crowd c, alone;
    visit v;
    peri_advance_desc a;
    peri_error error;
    peri_body *who;
    memset(&v, 0, sizeof v);
    crowd_make(&c, NULL, NULL, 1);
    crowd_make(&alone, NULL, NULL, 1);
    v.c = &c;
    peri_advance_desc_init(&a);
    a.steps = 100;
    a.frame_steps = 30;
    a.on_frame = look;
    a.user = &v;
    (void)world_must(c.world, peri_world_advance(c.world, &a));
    for (int k = 0; k < BODIES; ++k) CHECK(v.calls[k] == 4);
    CHECK(v.refused == 3 * 4 * BODIES);
    (void)world_must(alone.world, world_steps(alone.world, 100));
    CHECK(same_crowd(&c, &alone));
    v.stop_at = 6;
    CHECK(peri_world_advance(c.world, &a) == PERI_STOPPED);
    CHECK(peri_step_count(c.body[0]) == 160 && peri_step_count(c.body[3]) == 160);
    const double nothing[2] = {0, 0};
    double soon = peri_time(c.body[1]) + 3.3 * (peri_time(c.body[1]) / 160);
    const int32_t wish = (int32_t)MUST(c.body[1], peri_apply_body_force(c.body[1], PERI_ALL, nothing, wish_to_stop, &soon));
    v.stop_at = 0;
    CHECK(peri_world_advance(c.world, &a) == PERI_STOPPED);
    for (int k = 0; k < BODIES; ++k) CHECK(peri_step_count(c.body[k]) == peri_step_count(c.body[0]));
    CHECK(peri_step_count(c.body[0]) > 160 && peri_step_count(c.body[0]) < 180);
    (void)MUST(c.body[1], peri_remove_load(c.body[1], wish));
    (void)MUST(c.body[2], peri_apply_body_force(c.body[2], PERI_ALL, nothing, refuse, NULL));
    CHECK(peri_world_advance(c.world, &a) == PERI_ERROR_CALLBACK);
    CHECK(peri_world_get_error(c.world, &error, &who) == PERI_OK);
    CHECK(error.code == PERI_ERROR_CALLBACK && error.value == -7 && who == c.body[2]);
    for (int k = 0; k < BODIES; ++k) (void)MUST(c.body[k], peri_reset(c.body[k]));
    CHECK(peri_world_advance(c.world, &a) == PERI_ERROR_CALLBACK); /* later */
    CHECK(peri_time(c.body[0]) > 2e-6);
    crowd_drop(&c), crowd_drop(&alone);
}

/* A frame of one body may change another; both go on as if each had changed itself. */
static int32_t cut_the_first(void *user, peri_body *b) {
    crowd *c = (crowd *)user;
    const double from[2] = {4e-3, -1}, to[2] = {4e-3, 1};
    if (b == c->body[BODIES - 1]) (void)MUST(c->body[0], peri_cut_segment(c->body[0], PERI_CUT_NOW, from, to));
    return 0;
}

static int32_t cut_itself(void *user, peri_body *b) {
    const crowd *c = (const crowd *)user;
    const double from[2] = {4e-3, -1}, to[2] = {4e-3, 1};
    if (b == c->body[0]) (void)MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to));
    return 0;
}

static void frames_may_change_any(void) {
    crowd c[2];
    peri_energy e;
    for (int k = 0; k < 2; ++k) {
        peri_advance_desc a;
        crowd_make(&c[k], NULL, NULL, 1);
        peri_advance_desc_init(&a);
        a.steps = 40;
        a.frame_steps = 20;
        a.on_frame = k ? cut_itself : cut_the_first;
        a.user = &c[k];
        (void)world_must(c[k].world, peri_world_advance(c[k].world, &a));
        (void)world_must(c[k].world, world_steps(c[k].world, 20));
    }
    CHECK(same_crowd(&c[0], &c[1]));
    CHECK(peri_broken_count(c[0].body[0]) > 50);
    (void)world_must(c[0].world, peri_world_get_energy(c[0].world, &e));
    CHECK_NEAR(e.error / e.initial, 0, 0, 0.01);
    crowd_drop(&c[0]), crowd_drop(&c[1]);
}

/* A callback that leaves the run by a jump. */
static jmp_buf away;

static int32_t jump(void *user, peri_body *b) {
    if (b == ((crowd *)user)->body[2]) longjmp(away, 1);
    return 0;
}

static void jumps_leave_what_can_be_reset(void) {
    static crowd c, whole;
    pool p = {0, 0, 0, 0, -1, 0};
    peri_advance_desc a;
    crowd_make(&c, &p, NULL, 1);
    crowd_make(&whole, NULL, NULL, 1);
    peri_advance_desc_init(&a);
    a.steps = 50;
    a.frame_steps = 30;
    a.on_frame = jump;
    a.user = &c;
    if (setjmp(away) == 0) {
        (void)peri_world_advance(c.world, &a);
        CHECK(0);
    }
    a.on_frame = NULL;
    CHECK(peri_world_advance(c.world, &a) == PERI_ERROR_ORDER);
    for (int k = 0; k < BODIES; ++k) CHECK(peri_unlock(c.body[k]) == PERI_OK);
    CHECK(peri_world_advance(c.world, &a) == PERI_ERROR_ORDER); /* they are torn */
    for (int k = 0; k < BODIES; ++k) {
        const double v[2] = {k % 2 ? -40 : 40, k / 2 ? -30 : 30}, way[2] = {k % 2 * 8.3e-3, k / 2 * 8.3e-3};
        (void)MUST(c.body[k], peri_reset(c.body[k]));
        (void)MUST(c.body[k], peri_add_displacement(c.body[k], PERI_ALL, way));
        (void)MUST(c.body[k], peri_add_velocity(c.body[k], PERI_ALL, v));
    }
    (void)world_must(c.world, peri_world_advance(c.world, &a));
    (void)world_must(whole.world, peri_world_advance(whole.world, &a));
    CHECK(same_crowd(&c, &whole));
    crowd_drop(&c), crowd_drop(&whole);
    CHECK(p.blocks == 0 && p.wrong == 0);
}

/* ---- memory ------------------------------------------------------------------------------------------------------------------------ */

/* Whichever allocation of the world fails, the call says so and may be made again; what comes of it has the same bits. */
static void memory_may_fail_anywhere(void) {
    crowd whole;
    pool p = {0, 0, 0, 0, -1, 0};
    crowd_make(&whole, &p, NULL, 1);
    CHECK(peri_world_bytes(whole.world) == p.bytes);
    (void)world_must(whole.world, world_steps(whole.world, 120));
    CHECK(peri_world_bytes(whole.world) == p.bytes);
    const int64_t calls = p.calls;
    CHECK(calls > 100);
    for (int64_t fail = 1; fail < calls; fail += test_long ? 1 : 7) {
        crowd c;
        pool q = {0, 0, 0, 0, -1, 0};
        int failed = 0;
        peri_world_desc d;
        peri_contact_desc contact;
        peri_world_desc_init(&d);
        d.allocate = pool_take, d.release = pool_give, d.memory_user = &q;
        q.fail_at = 0;
        CHECK(peri_world_create(&d, &c.world, NULL) == PERI_ERROR_MEMORY && !c.world);
        q.calls = 0;
        q.fail_at = fail;
        CHECK(peri_world_create(&d, &c.world, NULL) == PERI_OK);
        for (int k = 0; k < BODIES; ++k) {
            (void)MUST(whole.body[k], peri_body_clone(whole.body[k], &c.body[k], NULL));
            const double v[2] = {k % 2 ? -40 : 40, k / 2 ? -30 : 30}, way[2] = {k % 2 * 8.3e-3, k / 2 * 8.3e-3};
            (void)MUST(c.body[k], peri_reset(c.body[k]));
            (void)MUST(c.body[k], peri_add_displacement(c.body[k], PERI_ALL, way));
            (void)MUST(c.body[k], peri_add_velocity(c.body[k], PERI_ALL, v));
            const int32_t status = peri_world_add(c.world, c.body[k]);
            CHECK(status == PERI_OK || status == PERI_ERROR_MEMORY);
            failed += status < 0;
            if (status < 0) (void)world_must(c.world, peri_world_add(c.world, c.body[k]));
        }
        peri_contact_desc_init(&contact);
        contact.friction = 0.2;
        contact.restitution = 0.5;
        const int32_t status = peri_world_set_contact(c.world, NULL, NULL, &contact);
        failed += status < 0;
        if (status < 0) (void)world_must(c.world, peri_world_set_contact(c.world, NULL, NULL, &contact));
        const int32_t run = world_steps(c.world, 120);
        CHECK(run == PERI_OK || run == PERI_ERROR_MEMORY);
        failed += run < 0;
        if (run < 0 && peri_step_count(c.body[0]) < 120)
            (void)world_must(c.world, world_steps(c.world, 120 - peri_step_count(c.body[0])));
        CHECK(failed == 1);
        if (run == PERI_OK) CHECK(same_crowd(&c, &whole));
        crowd_drop(&c);
        CHECK(q.blocks == 0 && q.bytes == 0 && q.wrong == 0);
    }
    crowd_drop(&whole);
    CHECK(p.blocks == 0 && p.bytes == 0 && p.wrong == 0);
}

/* ---- nonsense ---------------------------------------------------------------------------------------------------------------------- */

static int says(peri_world *w, int32_t status, const char *field) {
    peri_error e;
    return peri_world_get_error(w, &e, NULL) == PERI_OK && e.code == status && strcmp(e.field, field) == 0;
}

static void nonsense_is_refused(void) {
    bars s = bars_of(2, 2, 4, 4), t = bars_of(3, 2, 3, 3);
    peri_body *b = bar_at(&s, 0, 0), *other = bar_at(&s, 5e-3, 0), *solid = bar_at(&t, 0, 0), *raw = NULL;
    peri_world *w = NULL, *second = NULL;
    peri_world_desc d;
    peri_contact_desc c;
    peri_advance_desc a;
    peri_energy e;
    double force[3];
    peri_world_desc_init(&d);
    peri_world_desc_init(NULL);
    CHECK(peri_world_create(NULL, &w, NULL) == PERI_ERROR_ARGUMENT && !w);
    w = world_make();
    d.allocate = pool_take;
    CHECK(peri_world_create(&d, &second, NULL) == PERI_ERROR_ARGUMENT && !second);
    d.cookie++;
    CHECK(peri_world_create(&d, &second, NULL) == PERI_ERROR_DESCRIPTOR);
    second = world_make();
    (void)MUST(NULL, peri_body_create(&s.desc, &raw, NULL));
    peri_advance_desc_init(&a);
    a.steps = 1;
    CHECK(peri_world_advance(w, &a) == PERI_ERROR_EMPTY && says(w, PERI_ERROR_EMPTY, "peri_world_add"));
    CHECK(peri_world_stable_step(w) == 0 && peri_world_stable_step(NULL) == 0);
    CHECK(peri_world_get_energy(w, &e) == PERI_OK && e.kinetic == 0);
    CHECK(peri_world_add(w, raw) == PERI_ERROR_ORDER && says(w, PERI_ERROR_ORDER, "peri_build"));
    CHECK(peri_world_add(w, NULL) == PERI_ERROR_ARGUMENT && says(w, PERI_ERROR_ARGUMENT, "body"));
    (void)world_must(w, peri_world_add(w, b));
    CHECK(peri_world_add(w, b) == PERI_ERROR_ARGUMENT && peri_world_add(second, b) == PERI_ERROR_ARGUMENT);
    CHECK(peri_world_add(w, solid) == PERI_ERROR_CHOICE && says(w, PERI_ERROR_CHOICE, "space"));
    (void)world_must(w, peri_world_add(w, other));
    peri_contact_desc_init(&c);
    CHECK(peri_world_set_contact(w, b, b, &c) == PERI_ERROR_ARGUMENT && says(w, PERI_ERROR_ARGUMENT, "b"));
    CHECK(peri_world_set_contact(w, b, solid, &c) == PERI_ERROR_ARGUMENT && says(w, PERI_ERROR_ARGUMENT, "b"));
    CHECK(peri_world_set_contact(w, raw, b, &c) == PERI_ERROR_ARGUMENT && says(w, PERI_ERROR_ARGUMENT, "a"));
    c.distance = 2.01e-3;
    CHECK(peri_world_set_contact(w, NULL, NULL, &c) == PERI_ERROR_RANGE && says(w, PERI_ERROR_RANGE, "distance"));
    c.distance = 0;
    c.restitution = 0.01;
    CHECK(peri_world_set_contact(w, b, NULL, &c) == PERI_ERROR_RANGE && says(w, PERI_ERROR_RANGE, "restitution"));
    c.restitution = 1;
    c.stiffness = 0;
    CHECK(peri_world_set_contact(w, b, NULL, &c) == PERI_ERROR_RANGE && says(w, PERI_ERROR_RANGE, "stiffness"));
    c.stiffness = 1;
    c.friction = -1;
    CHECK(peri_world_set_contact(w, b, NULL, &c) == PERI_ERROR_RANGE && says(w, PERI_ERROR_RANGE, "friction"));
    c.friction = 0;
    c.friction_speed = -1;
    CHECK(peri_world_set_contact(w, b, NULL, &c) == PERI_ERROR_RANGE && says(w, PERI_ERROR_RANGE, "friction_speed"));
    c.cookie++;
    CHECK(peri_world_set_contact(w, b, NULL, &c) == PERI_ERROR_DESCRIPTOR);
    CHECK(peri_world_advance(w, NULL) == PERI_ERROR_ARGUMENT && peri_world_advance(NULL, &a) == PERI_ERROR_ARGUMENT);
    a.time_step = 1.01 * peri_world_stable_step(w);
    CHECK(peri_world_advance(w, &a) == PERI_ERROR_STEP && says(w, PERI_ERROR_STEP, "time_step"));
    a.safety = 2;
    CHECK(peri_world_advance(w, &a) == PERI_ERROR_RANGE && says(w, PERI_ERROR_RANGE, "safety"));
    CHECK(peri_step_count(b) == 0 && peri_step_count(other) == 0);
    CHECK(peri_world_get_force(w, solid, force) == PERI_ERROR_ARGUMENT && peri_world_get_force(w, b, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_world_get_force(w, b, force) == PERI_OK && force[0] == 0);
    CHECK(peri_world_get_energy(w, NULL) == PERI_ERROR_ARGUMENT && peri_world_get_energy(NULL, &e) == PERI_ERROR_ARGUMENT);
    CHECK(peri_world_bytes(NULL) == PERI_ERROR_ARGUMENT && peri_world_remove(NULL, b) == PERI_ERROR_ARGUMENT);
    CHECK(peri_world_get_error(NULL, NULL, NULL) == PERI_ERROR_ARGUMENT);
    peri_world_destroy(NULL);
    peri_body_destroy(raw), peri_body_destroy(solid), peri_body_destroy(b);
    CHECK(peri_world_remove(w, other) == PERI_OK && peri_world_add(second, other) == PERI_OK);
    peri_world_destroy(w), peri_world_destroy(second);
    CHECK(peri_advance(other, &a) == PERI_ERROR_RANGE);
    peri_body_destroy(other);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(callbacks_are_heeded);
    RUN(frames_may_change_any);
    RUN(jumps_leave_what_can_be_reset);
    RUN(memory_may_fail_anywhere);
    RUN(nonsense_is_refused);
    return test_end("test_world_calls");
}
