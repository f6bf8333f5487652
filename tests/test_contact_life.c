/* SPDX-License-Identifier: MIT */
/* test_contact_life.c - contact in the life of a body: bonds that break, clones, resets, memory that fails, steps, equilibria, rubble.

   SOURCE OF TRUTH: the ledger balances; a clone, a reset body and one on other threads have the same bits; a call that fails has changed
   nothing; a closed crack carries what the whole block does, an open one nothing; rubble comes to rest, apart. */
#include "contact_scene.h"
#include "pool.h"

/* ---- bonds ---------------------------------------------------------------------------------------------------------------------- */

/* A block is pressed together and cut through, of whole bonds: the faces take over at once, and what that puts in is the caller's. From
   there on the ledger balances to the square of the step. */
static void the_ledger_follows_cuts_under_pressure(void) {
    for (int kind = 0; kind < 2; ++kind) {
        double error[2];
        for (int fine = 0; fine < 2; ++fine) {
            const double lo[2] = {0, 0}, hi[2] = {16, 16}, from[2] = {-1, 8}, to[2] = {17, 8};
            double u[512];
            peri_energy e;
            peri_body_desc d;
            peri_contact_desc c;
            peri_material_desc m;
            peri_advance_desc a;
            peri_body *b = NULL;
            peri_body_desc_init(&d);
            d.space = PERI_SPACE_PLANE_STRAIN;
            d.horizon = 3;
            (void)MUST(NULL, peri_body_create(&d, &b, NULL));
            peri_material_desc_init(&m, kind == 0 ? PERI_LAW_BOND_BASED : PERI_LAW_LPS);
            m.young = m.density = 1;
            if (kind > 0) m.poisson = 0.25;
            (void)MUST(b, peri_add_material(b, &m));
            (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
            (void)MUST(b, peri_build(b));
            peri_contact_desc_init(&c);
            (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
            for (int i = 0; i < 256; ++i) {
                u[2 * i] = 0;
                u[2 * i + 1] = -0.04 * (i / 16);
            }
            (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 512));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(e.contact == 0);
            const double whole = e.elastic;
            CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to)) > 0);
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK_NEAR(e.error, 0, 0, 1e-12);
            /* 16 columns, each pressed by 0.04; bonds across the cut held more */
            CHECK_NEAR(e.contact, 16 * 0.5 * 0.25 * 0.04 * 0.04, 1e-9, 0);
            CHECK(e.contact + e.elastic < whole);
            CHECK_NEAR(e.initial, e.elastic + e.contact, 1e-12, 0);
            peri_advance_desc_init(&a);
            a.time_step = fine ? 0.18 : 0.36;
            a.steps = fine ? 16 : 8;
            (void)MUST(b, peri_advance(b, &a));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK(e.contact > 0.01);
            error[fine] = fabs(e.error) / e.initial;
            peri_energy left;
            (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL)); /* which takes out what was stored */
            (void)MUST(b, peri_get_energy(b, &left));
            CHECK(left.contact == 0);
            CHECK_NEAR(left.initial, e.initial - e.contact, 1e-12, 0);
            CHECK_NEAR(left.error, e.error, 0, 1e-12);
            peri_body_destroy(b);
        }
        CHECK(error[0] < 0.01 && error[1] < 0.35 * error[0]);
    }
}

/* As a crack runs through a stretched strip, what breaks in tension does not jump: the motion is that of a body without contact until the
   faces come back. */
static void breaking_in_tension_does_not_jump(void) {
    const double lo[2] = {0, 0}, hi[2] = {24, 12}, from[2] = {-1, 6}, to[2] = {6, 6};
    double u[576];
    peri_body_desc d;
    peri_contact_desc c;
    peri_advance_desc a;
    peri_energy e;
    peri_body *b, *free_of;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3;
    b = test_unit_body(&d, 0.02);
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    for (int i = 0; i < 288; ++i) {
        u[2 * i] = 0.005 * (i % 24);
        u[2 * i + 1] = 0.022 * (i / 24);
    }
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 576));
    (void)MUST(b, peri_body_clone(b, &free_of, NULL));
    peri_contact_desc_init(&c);
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
    peri_advance_desc_init(&a);
    a.time_step = 0.9 * peri_stable_step(b);
    a.steps = 1;
    int same = 0;
    for (; same < 40; ++same) {
        (void)MUST(b, peri_advance(b, &a));
        (void)MUST(free_of, peri_advance(free_of, &a));
        (void)MUST(b, peri_get_energy(b, &e));
        if (e.contact > 0) break;
        CHECK(same_motion(b, free_of));
    }
    CHECK(same >= 2 && peri_broken_count(b) > 200);
    peri_body_destroy(free_of);
    peri_body_destroy(b);
}

/* ---- the same bits -------------------------------------------------------------------------------------------------------------- */

/* Two brittle blocks meet obliquely. */
static bars crash(void) {
    bars s = bars_of(2, 3, 14, 14);
    s.material.critical_stretch = 0.002;
    s.contact.friction = 0.4;
    s.contact.restitution = 0.7;
    s.speed = 60;
    s.offset = 3.3;
    return s;
}

static int64_t rounds_in_parallel;
static void backwards(void *user, int64_t count, peri_task_fn task, void *context) {
    (void)user;
    rounds_in_parallel++;
    for (int64_t k = count; k-- > 0;) task(context, k);
}

static void clones_and_resets_go_on_alike(void) {
    bars s = crash();
    peri_body *a = bars_make(&s), *b = NULL, *once;
    const double v[2] = {60, 0};
    (void)MUST(a, peri_body_clone(a, &once, NULL));
    for (int k = 0; k < 4; ++k) {
        CHECK(run_steps(a, 200) == PERI_OK);
        if (k == 1) (void)MUST(a, peri_body_clone(a, &b, NULL));
        if (k > 1) CHECK(run_steps(b, 200) == PERI_OK);
    }
    CHECK(peri_broken_count(a) > 100);
    CHECK(same_motion(a, b));
    (void)MUST(b, peri_reset(b));
    (void)MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_find_set(b, "first")), v));
    for (int k = 0; k < 4; ++k) {
        CHECK(run_steps(b, 200) == PERI_OK);
        CHECK(run_steps(once, 200) == PERI_OK);
    }
    CHECK(same_motion(a, b));
    CHECK(same_motion(a, once));
    peri_body_destroy(once);
    peri_body_destroy(a);
    peri_body_destroy(b);
}

/* A pane of 8,000 points falls apart on others: by one thread, by a job system that works from the end. */
static void jobs_do_not_matter(void) {
    bars s = bars_of(2, 3, 90, 44);
    peri_body *a, *b;
    peri_advance_desc r;
    const double lo[2] = {-1, -1}, hi[2] = {1, 1}, way[2] = {-3.61e-3, 0};
    s.speed = 100;
    s.contact.friction = 0.3;
    s.material.critical_stretch = 0.002;
    a = bars_make(&s);
    s.desc.threads = 0;
    s.desc.parallel_for = backwards;
    b = bars_make(&s);
    peri_advance_desc_init(&r);
    r.steps = 12;
    for (int k = 0; k < 2; ++k) {
        peri_body *body = k ? b : a;
        (void)MUST(body, peri_select_box(body, "all", lo, hi));
        (void)MUST(body, peri_add_displacement(body, (int32_t)MUST(body, peri_find_set(body, "second")), way));
        (void)MUST(body, peri_advance(body, &r));
    }
    CHECK(rounds_in_parallel > 20);
    CHECK(same_motion(a, b));
    peri_body_destroy(a);
    peri_body_destroy(b);
}

/* Parts that are 1e13 spacings apart, or that move on by that, cost no more than others; and the frame does not matter. */
static void distance_does_not_matter(void) {
    bars s = bars_of(2, 2, 8, 4);
    double first, second;
    const double far[2] = {1e10, -1e9}, nothing[2] = {3e9, 0};
    s.spacing = 0x1p-10;
    s.desc.horizon = 2.0001 * s.spacing;
    s.contact.restitution = 1;
    peri_body *b = bars_make(&s);
    (void)MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_find_set(b, "second")), far));
    CHECK(run_steps(b, 50) == PERI_OK);
    mean_speeds(b, &first, &second);
    CHECK_NEAR(first, s.speed, 1e-12, 0);
    CHECK_NEAR(second, 0, 0, 1e-12);
    (void)MUST(b, peri_add_displacement(b, PERI_ALL, nothing));
    CHECK(run_steps(b, 50) == PERI_OK);
    peri_body_destroy(b);
}

/* ---- the step ------------------------------------------------------------------------------------------------------------------- */

static void the_stable_step_knows_of_contact(void) {
    bars s = bars_of(2, 3, 10, 6);
    peri_advance_desc a;
    peri_error error;
    s.offset = 0.5;
    peri_body *b = bars_make(&s);
    peri_contact_desc c = s.contact;
    const double soft = peri_stable_step(b), into[2] = {-14.1 * s.spacing, 0}; /* between the points of the first */
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    const double without = peri_stable_step(b);
    CHECK_NEAR(soft / without, 0.74, 0.03, 0);
    c.stiffness = 2;
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
    const double stiff = peri_stable_step(b);
    /* by sum of squares of frequencies: 4 from the bonds' own step, and eight times as much of contact */
    CHECK_NEAR(1 / (stiff * stiff) - 1 / (without * without), 8 * (1 / (soft * soft) - 1 / (without * without)), 1e-9, 0);
    /* one in the other: each point touches many, and the step is less; who insists is told so, at a whole step */
    (void)MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_find_set(b, "second")), into));
    CHECK(peri_stable_step(b) < 0.95 * stiff);
    peri_advance_desc_init(&a);
    a.time_step = stiff;
    a.steps = 10;
    CHECK(peri_advance(b, &a) == PERI_ERROR_STEP);
    (void)MUST(b, peri_get_error(b, &error));
    CHECK_NEAR(error.value, peri_stable_step(b), 1e-9, 0);
    CHECK(run_steps(b, 400) == PERI_OK); /* the automatic step follows */
    peri_energy e;
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK_NEAR(e.error / e.initial, 0, 0, 0.1); /* unstable, it would be beyond all numbers */
    peri_body_destroy(b);
}

/* "At the default stiffness and a horizon of 3 spacings [...] 0.55 to 0.62 in 3D." */
static void the_stable_step_in_space(void) {
    bars s = bars_of(3, 3, 16, 5);
    peri_body *b = bars_make(&s);
    const double with = peri_stable_step(b);
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    CHECK(with > 0.55 * peri_stable_step(b) && with < 0.62 * peri_stable_step(b));
    peri_body_destroy(b);
}

/* A small block is moved into the middle of a large one: only what is at a surface pushes, and the large one is whole there. */
static void insides_are_not_searched(void) {
    const double lo[2] = {0, 0}, hi[2] = {20, 20}, lo2[2] = {30, 8.3}, hi2[2] = {33, 11.3}, way[2] = {-23.5, 0};
    peri_body_desc d;
    peri_contact_desc c;
    peri_energy e;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRAIN;
    d.horizon = 3;
    peri_body *b = test_unit_body(&d, 0);
    const int32_t id = peri_id(b, PERI_KIND_MATERIAL, 1);
    (void)MUST(b, peri_add_box(b, id, lo, hi, 1));
    (void)MUST(b, peri_add_box(b, id, lo2, hi2, 1));
    (void)MUST(b, peri_build(b));
    peri_contact_desc_init(&c);
    (void)MUST(b, peri_set_contact(b, id, id, &c));
    (void)MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi2)), way));
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(e.contact == 0);
    const int32_t pair[2] = {210, 211}; /* in the middle: its neighbours, which the small one touches, are whole still */
    CHECK(MUST(b, peri_cut_pairs(b, PERI_CUT_NOW, 1, pair)) == 1);
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(e.contact == 0);
    const double on[2] = {-6.2, 0}; /* across its left surface */
    (void)MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi2)), on));
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(e.contact > 0);
    peri_body_destroy(b);
}

/* ---- memory and misuse ---------------------------------------------------------------------------------------------------------- */

/* Allocations of the run, each of the first searches and many of the later ones, fail once; the call is made again, and the end has
   the same bits, but where steps were done before memory ran short: the last of them was done by the lists that there were. */
static void memory_may_fail_anywhere(void) {
    bars s = crash();
    pool never = {0, 0, 0, 0, -1, 0}, p;
    peri_body *want, *b;
    peri_memory held;
    int64_t failed = 0, same = 0;
    s.contact.friction = 0;
    s.contact.restitution = 1;
    s.across[0] = s.across[1] = 5;
    s.offset = 1.3;
    hook(&s.desc, &never);
    want = bars_make(&s);
    const int64_t built = never.calls;
    for (int k = 0; k < 160; ++k) CHECK(run_steps(want, 5) == PERI_OK);
    CHECK(peri_broken_count(want) > 10);
    (void)MUST(want, peri_get_memory(want, &held));
    CHECK(never.bytes >= held.total && never.bytes < held.total + 64);
    for (int64_t at = built; at < never.calls + 20; at += at < built + 24 ? 1 : 13) {
        memset(&p, 0, sizeof p);
        p.fail_at = at;
        s.desc.memory_user = &p;
        b = bars_make(&s);
        int stepped = 0;
        for (int64_t k = 0; k < 160; ++k) {
            const int64_t steps = peri_step_count(b);
            const int32_t status = run_steps(b, 5);
            if (status == PERI_OK) continue;
            CHECK(status == PERI_ERROR_MEMORY);
            stepped = peri_step_count(b) > steps;
            failed++;
            while (peri_step_count(b) < steps + 5 && run_steps(b, steps + 5 - peri_step_count(b)) == PERI_OK) {}
        }
        if (!stepped) {
            CHECK(same_motion(b, want));
            same++;
        }
        peri_body_destroy(b);
        CHECK(p.bytes == 0);
    }
    CHECK(failed > 5 && same > 5);
    peri_body_destroy(want);
    CHECK(never.bytes == 0);
}

/* So does every allocation of the declaration itself, and of a clone: nothing is lost, nothing changed. */
static void declarations_may_fail(void) {
    bars s = crash();
    pool p = {0, 0, 0, 0, -1, 0};
    peri_contact_desc c = s.contact;
    peri_body *copy;
    int refused = 0;
    hook(&s.desc, &p);
    peri_body *b = bars_make(&s);
    CHECK(run_steps(b, 700) == PERI_OK);
    const double step = peri_stable_step(b);
    c.stiffness = 1;
    for (int64_t at = 0; at < 12; ++at) {
        const int64_t live = p.bytes;
        p.fail_at = p.calls + at;
        const int32_t status = peri_set_contact(b, PERI_ALL, PERI_ALL, &c);
        p.fail_at = -1;
        if (status == PERI_OK) break;
        refused++;
        CHECK(status == PERI_ERROR_MEMORY);
        CHECK(p.bytes == live);
        CHECK(peri_stable_step(b) == step);
    }
    CHECK(refused >= 4);
    CHECK(peri_stable_step(b) < step);
    for (int64_t at = 0; at < 60; ++at) {
        const int64_t live = p.bytes;
        p.fail_at = p.calls + at;
        const int32_t status = peri_body_clone(b, &copy, NULL);
        p.fail_at = -1;
        if (status < 0) CHECK(p.bytes == live);
        if (status == PERI_OK) break;
    }
    peri_body_destroy(copy);
    peri_body_destroy(b);
    CHECK(p.bytes == 0);
}

#define REFUSED(change, wanted, name, number)                                                                          \
    do {                                                                                                               \
        peri_error record;                                                                                              \
        peri_contact_desc c = s.contact;                                                                               \
        change;                                                                                                        \
        CHECK(peri_set_contact(b, PERI_ALL, PERI_ALL, &c) == (wanted));                                                \
        (void)peri_get_error(b, &record);                                                                               \
        CHECK(record.code == (wanted) && strcmp(record.field, name) == 0);                                               \
        if (!(number != number)) CHECK_NEAR(record.value, number, 1e-12, 0);                                            \
    } while (0)

static void nonsense_is_refused(void) {
    bars s = bars_of(2, 3, 4, 4);
    peri_error error;
    peri_body *b = bars_make(&s);
    const double step = peri_stable_step(b);
    REFUSED(c.cookie = 0, PERI_ERROR_DESCRIPTOR, "desc", 0);
    REFUSED(c.stiffness = 0, PERI_ERROR_RANGE, "stiffness", 0);
    REFUSED(c.stiffness = 1001, PERI_ERROR_RANGE, "stiffness", 1001);
    REFUSED(c.stiffness = NAN, PERI_ERROR_RANGE, "stiffness", NAN);
    REFUSED(c.distance = -1, PERI_ERROR_RANGE, "distance", -1);
    REFUSED(c.distance = 4e-3, PERI_ERROR_RANGE, "distance", 4e-3);
    REFUSED(c.friction = -0.1, PERI_ERROR_RANGE, "friction", -0.1);
    REFUSED(c.friction = INFINITY, PERI_ERROR_RANGE, "friction", NAN);
    REFUSED(c.friction_speed = -1, PERI_ERROR_RANGE, "friction_speed", -1);
    REFUSED(c.restitution = 0, PERI_ERROR_RANGE, "restitution", 0);
    REFUSED(c.restitution = 1.1, PERI_ERROR_RANGE, "restitution", 1.1);
    REFUSED(c.restitution = 0.01, PERI_ERROR_RANGE, "restitution", NAN);
    (void)peri_get_error(b, &error);
    CHECK(error.value > 0.3 && error.value < 0.7); /* what is in reach */
    s.contact.restitution = error.value * 1.001;
    CHECK(peri_set_contact(b, PERI_ALL, PERI_ALL, &s.contact) == PERI_OK);
    s.contact.restitution = 1;
    CHECK(peri_set_contact(b, PERI_ALL, PERI_ALL, &s.contact) == PERI_OK);
    CHECK(peri_set_contact(b, 0, PERI_ALL, &s.contact) == PERI_ERROR_ID_NONE);
    (void)peri_get_error(b, &error);
    CHECK(strcmp(error.field, "i") == 0);
    CHECK(peri_set_contact(b, PERI_ALL, peri_find_set(b, "first"), NULL) == PERI_ERROR_ID_KIND);
    (void)peri_get_error(b, &error);
    CHECK(strcmp(error.field, "j") == 0);
    CHECK(peri_set_contact(NULL, PERI_ALL, PERI_ALL, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_stable_step(b) == step);
    peri_contact_desc_init(NULL);
    peri_body_destroy(b);
}

/* A body without contact holds nothing for it. */
static void what_is_removed_is_gone(void) {
    bars s = crash();
    peri_memory before, with, after;
    s.speed = 0;
    peri_body *b = bars_make(&s);
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    (void)MUST(b, peri_get_memory(b, &before));
    (void)MUST(b, peri_set_contact(b, peri_id(b, PERI_KIND_MATERIAL, 1), PERI_ALL, &s.contact));
    CHECK(run_steps(b, 2) == PERI_OK);
    (void)MUST(b, peri_get_memory(b, &with));
    (void)MUST(b, peri_set_contact(b, PERI_ALL, peri_id(b, PERI_KIND_MATERIAL, 1), NULL));
    (void)MUST(b, peri_get_memory(b, &after));
    CHECK(with.total == with.loads - before.loads + before.total && with.loads > before.loads + 1000);
    CHECK(after.total == before.total);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_ledger_follows_cuts_under_pressure);
    RUN(breaking_in_tension_does_not_jump);
    RUN(clones_and_resets_go_on_alike);
    RUN(jobs_do_not_matter);
    RUN(distance_does_not_matter);
    RUN(the_stable_step_knows_of_contact);
    RUN(the_stable_step_in_space);
    RUN(insides_are_not_searched);
    RUN(memory_may_fail_anywhere);
    RUN(declarations_may_fail);
    RUN(nonsense_is_refused);
    RUN(what_is_removed_is_gone);
    return test_end("test_contact_life");
}
