/* SPDX-License-Identifier: MIT */
/* calls_worlds.h - of test_promises_calls.c, whose names it uses: what worlds refuse. */
#ifndef CALLS_WORLDS_H
#define CALLS_WORLDS_H

static peri_world *asked_world;

/* Within a step: nobody is at a whole one. */
static int32_t ask_in_a_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    peri_advance_desc run;
    (void)time, (void)count, (void)points, (void)value;
    peri_body *b = (peri_body *)user;
    peri_advance_desc_init(&run), run.steps = 1;
    ASK(peri_world_add(asked_world, b)), ASK(peri_world_remove(asked_world, b)), ASK(peri_world_set_contact(asked_world, b, NULL, NULL));
    ASK(peri_world_advance(asked_world, &run)), ASK(peri_world_get_energy(asked_world, &energy));
    return 1;
}

static int32_t no_row(void *user, const peri_bond_row *row) { return (void)user, (void)row, -1; }

static void world_without_memory(peri_world_desc *d, const specimen *s) {
    peri_advance_desc run;
    peri_contact_desc touch;
    peri_body *b = specimen_make(s), *c = specimen_make(s);
    const double away[2] = {10, 0};
    d->allocate = take, d->release = give;
    fail_in = 0, ASK(peri_world_create(d, &asked_world, NULL)), fail_in = -1;
    CHECK(peri_world_create(d, &asked_world, NULL) == PERI_OK);
    peri_advance_desc_init(&run), peri_contact_desc_init(&touch), run.steps = 1;
    MUST(c, peri_add_displacement(c, PERI_ALL, away));
    fail_in = 0, ASK(peri_world_add(asked_world, b)), fail_in = -1;
    CHECK(peri_world_add(asked_world, b) == PERI_OK && peri_world_add(asked_world, c) == PERI_OK);
    fail_in = 0, ASK(peri_world_set_contact(asked_world, NULL, NULL, &touch));
    fail_in = 0, ASK(peri_world_get_energy(asked_world, &energy));
    fail_in = 0, ASK(peri_world_advance(asked_world, &run)), fail_in = -1;
    touch.distance = 1.9, ASK(peri_world_set_contact(asked_world, b, NULL, &touch)), peri_body_destroy(c);
    touch.distance = 0.9, ASK(peri_world_set_contact(asked_world, NULL, NULL, &touch));
    touch.distance = 1.9, ASK(peri_world_set_contact(asked_world, NULL, NULL, &touch));
    specimen fine = *s; /* and of two half as coarse that distance is too long */
    fine.spacing = 0.4, fine.desc.horizon *= 0.4;
    ASK(peri_world_add(asked_world, c = specimen_make(&fine)));
    peri_body_destroy(b), peri_body_destroy(c), peri_world_destroy(asked_world);
}

static void world_runs(const specimen *s) {
    peri_advance_desc run;
    peri_body *b = specimen_make(s), *law;
    peri_advance_desc_init(&run), run.steps = 1;
    ASK(peri_world_advance(asked_world, &run));
    MUST(b, peri_world_add(asked_world, b)), ASK(peri_world_add(asked_world, b));
    ASK(peri_world_advance(asked_world, &run)), ASK(peri_world_advance(asked_world, NULL));
    run.cookie++, ASK(peri_world_advance(asked_world, &run)), run.cookie--;
    run.integrator = 7, ASK(peri_world_advance(asked_world, &run)), run.integrator = PERI_INTEGRATOR_VELOCITY_VERLET;
    run.safety = 2, ASK(peri_world_advance(asked_world, &run)), run.safety = 0.9;
    run.time_step = 1e9, ASK(peri_world_advance(asked_world, &run)), run.time_step = 0;
    const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, ask_in_a_load, b));
    ASK(peri_world_advance(asked_world, &run)), MUST(b, peri_remove_load(b, load));
    const int32_t failing = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, fail_load, NULL));
    ASK(peri_world_advance(asked_world, &run)), MUST(b, peri_remove_load(b, failing));
    (void)peri_reset(b);
    run.time_step = 1e3 * peri_world_stable_step(asked_world), run.force_step = 1, run.steps = 200;
    const int32_t unit = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, NULL, NULL));
    double v[240];
    for (int k = 0; k < 240; ++k) v[k] = k % 7;
    MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, 240));
    ASK(peri_world_advance(asked_world, &run)), MUST(b, peri_remove_load(b, unit));
    ASK(peri_world_get_force(asked_world, b, NULL)), ASK(peri_world_remove(asked_world, b)), ASK(peri_world_remove(asked_world, b));
    peri_body_destroy(b);
    law = specimen_start(s);
    const int32_t id = peri_id(law, PERI_KIND_MATERIAL, 1);
    MUST(law, peri_set_bond_law(law, id, id, 0, no_row, NULL)), MUST(law, peri_add_box(law, id, s->lo, s->hi, 1));
    MUST(law, peri_build(law)), MUST(law, peri_world_add(asked_world, law)), ASK(peri_world_get_energy(asked_world, &energy));
    peri_body_destroy(law);
}

static void with_worlds(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED), solid = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 2.1, 5, 4, 4);
    peri_body *b = specimen_make(&s), *raw = specimen_start(&s), *t = specimen_make(&solid);
    peri_world_desc d;
    peri_contact_desc touch;
    peri_part_desc p;
    fail_in = -1;
    peri_world_desc_init(&d), peri_contact_desc_init(&touch), peri_part_desc_init(&p);
    ASK(peri_world_create(NULL, &asked_world, NULL)), d.cookie++, ASK(peri_world_create(&d, &asked_world, NULL)), d.cookie--;
    d.sleep_speed = -1, ASK(peri_world_create(&d, &asked_world, NULL)), d.sleep_speed = 1, ASK(peri_world_create(&d, &asked_world, NULL));
    d.sleep_speed = 0, ASK(peri_world_create(&d, &asked_world, NULL)), ASK(peri_world_asleep(NULL, NULL));
    ASK(peri_world_add(NULL, b)), ASK(peri_world_add(asked_world, raw)), MUST(b, peri_world_add(asked_world, b));
    ASK(peri_world_add(asked_world, t)), ASK(peri_world_remove(NULL, b)), ASK(peri_world_bytes(NULL));
    ASK(peri_world_get_force(NULL, b, NULL));
    ASK(peri_world_get_error(NULL, NULL, NULL)), ASK(peri_world_get_energy(NULL, NULL)), ASK(peri_world_advance(NULL, NULL));
    ASK(peri_world_set_contact(NULL, b, NULL, &touch)), ASK(peri_world_set_contact(asked_world, b, b, &touch));
    touch.cookie++, ASK(peri_world_set_contact(asked_world, b, NULL, &touch)), touch.cookie--;
    touch.friction = -1, ASK(peri_world_set_contact(asked_world, b, NULL, &touch));
    MUST(raw, peri_add_box(raw, peri_id(raw, PERI_KIND_MATERIAL, 1), s.lo, s.hi, s.spacing));
    p.length = p.mean_volume = 1, p.reduce = run_otherwise, MUST(raw, peri_set_part(raw, &p));
    if (peri_build(raw) == PERI_OK) ASK(peri_world_add(asked_world, raw));
    peri_body_destroy(b), peri_body_destroy(raw), peri_body_destroy(t);
    world_runs(&s), peri_world_destroy(asked_world);
    world_without_memory(&d, &s);
}

#endif
