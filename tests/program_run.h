/* SPDX-License-Identifier: MIT */
/* program_run.h - programs: the table of calls, and a whole life from its bytes. */
#ifndef PROGRAM_RUN_H
#define PROGRAM_RUN_H

#include "program_calls.h"

/* What NULL and unknown numbers are answered with. */
static int64_t ask_for_nothing(program *p, int s) {
    peri_memory m;
    (void)s;
    peri_body_desc_init(NULL);
    peri_material_desc_init(NULL, PERI_LAW_LPS);
    peri_advance_desc_init(NULL);
    peri_solve_desc_init(NULL);
    peri_plan_desc_init(NULL);
    peri_body_destroy(NULL);
    peri_matrix_destroy(NULL);
    HOLDS(p, peri_status_text((int32_t)(draw(p) - 64)) != NULL);
    HOLDS(p, peri_format_error(NULL, NULL, 0) == PERI_ERROR_ARGUMENT && peri_get_memory(NULL, &m) == PERI_ERROR_ARGUMENT);
    HOLDS(p, peri_dimension(NULL) == 0 && peri_point_count(NULL) == 0 && peri_family_width(NULL) == 0 && peri_entry_count(NULL) == 0);
    HOLDS(p, peri_cut_count(NULL) == 0 && peri_broken_count(NULL) == 0 && peri_step_count(NULL) == 0 && peri_load_factor(NULL) == 0.0);
    HOLDS(p, peri_time(NULL) == 0.0 && peri_stable_step(NULL) == 0.0 && peri_id(NULL, PERI_KIND_SET, 1) == PERI_ERROR_ARGUMENT);
    HOLDS(p, peri_kernel_text(NULL)[0] == 0 && peri_find_set(NULL, "a") == PERI_ERROR_ARGUMENT);
    return 0;
}

static int64_t destroy(program *p, int s) {
    drop(p, s);
    p->partial = 1;
    return 0;
}

static const struct {
    const char *name;
    int64_t (*make)(program *p, int s);
} table[] = {
    {"advance", advance}, {"solve", solve}, {"cut", cut}, {"select_points", select_points}, {"add_load", add_load},
    {"add_obstacle", add_obstacle}, {"add_motion", add_motion}, {"write_state", write_state}, {"reset", reset}, {"clone", clone},
    {"twins", twins}, {"destroy", destroy}, {"make_body", make_body}, {"add_material", add_material}, {"set_interface", set_interface},
    {"add_box", add_box}, {"add_ball", add_ball}, {"add_shape", add_shape}, {"add_perturbed_box", add_perturbed_box},
    {"add_points", add_points}, {"set_families", set_families}, {"build", build}, {"plan", plan}, {"look_at_sets", look_at_sets},
    {"set_no_fail", set_no_fail}, {"tell_breaks", tell_breaks}, {"look_at_bonds", look_at_bonds}, {"remove_load", remove_load},
    {"remove_obstacle", remove_obstacle}, {"look_at_forces", look_at_forces}, {"look_at_fields", look_at_fields}, {"write_out", write_out},
    {"look_at_constants", look_at_constants}, {"multiply", multiply}, {"assemble", assemble}, {"ask_for_nothing", ask_for_nothing},
    {"add_cells", add_cells},
};
#define TABLE ((int)(sizeof table / sizeof *table))

enum { MOVES = 7, MAKES = 13, MAKES_END = 22, FIRST_TABLE = 36 };

/* Mostly a call that the body is ready for; half of those of a built body are of the first seven, which make things happen. The numbers of
   calls that are added later are left over from here. */
static int some_call(program *p, int s) {
    const slot *o = &p->slots[s];
    const int which = draw(p), built = points_of(o) > 0;
    const int k = which < 128 ? which % MOVES : which - 128 < TABLE ? which - 128 : (which - 128) % FIRST_TABLE;
    const int makes = k >= MAKES && k < MAKES_END;
    if (which % 16 == 5) return k;
    if (!o->body) return MAKES - 1; /* make_body */
    if (materials_of(o) == 0) return MAKES; /* add_material */
    if (!built && !makes) return MAKES + which % (MAKES_END - MAKES);
    return built && makes ? which % MAKES : k;
}

static int64_t one_call(program *p, int s) {
    const int k = some_call(p, s), deep = p->calls % 3 == 0, level = p->level;
    print before, after;
    begin_call(p);
    const int64_t fail_at = p->memory.fail_at;
    p->memory.fail_at = -1;
    before = print_of(p, s, deep);
    p->memory.fail_at = fail_at;
    if (p->trace) printf("  call %d slot %d: %s, mood %d\n", p->calls, s, table[k].name, p->mood);
    const int64_t status = table[k].make(p, s);
    p->memory.fail_at = -1;
    p->wild = 0;
    p->want = PERI_OK;
    if (status < 0 && p->partial != 1) {
        after = print_of(p, s, deep);
        if (p->partial == PARTLY || p->slots[s].lost) before.deep = after.deep = 0;
        if (p->partial == PARTLY || p->slots[s].lost) before.step = after.step = 0.0;
        if (!same_print(before, after, (int32_t)status)) blame(p, "a call that is refused changes nothing", __LINE__);
    }
    HOLDS(p, p->level == level);
    if (p->level == 0) check_memory(p);
    return status;
}

/* ---- scenes ------------------------------------------------------------------------------------------------------- */

static void add_some_points(program *p, int s, int shape) {
    if (shape < 8) (void)add_box(p, s);
    else if (shape < 10) (void)add_perturbed_box(p, s);
    else if (shape < 12) (void)add_points(p, s);
    else if (shape < 13) (void)add_shape(p, s);
    else (void)add_ball(p, s);
    if (shape == 15 || shape == 7) (void)add_box(p, s);
}

/* Holds the left of a body, and pulls its right, or not; a crack between them, or none. */
static void hold_scene(program *p, int s, int kind) {
    const slot *o = &p->slots[s];
    const int32_t axes = o->dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    double lo[3], hi[3], pull[3] = {0, 0, 0};
    int32_t set;
    int d;
    for (d = 0; d < 3; ++d) {
        lo[d] = o->lo[d];
        hi[d] = o->hi[d];
    }
    hi[0] = o->lo[0] + 1.25 * o->length;
    set = (int32_t)CALL(p, s, peri_select_box(o->body, "left", lo, hi));
    note_id(p, s, PERI_KIND_SET, set);
    if (set < 0) p->want = PERI_ERROR_ID_NONE; /* what a call that failed has returned is none */
    note_id(p, s, PERI_KIND_LOAD, CALL(p, s, peri_prescribe_displacement(o->body, set, kind % 4 ? axes : PERI_AXIS_X, NULL, NULL, NULL)));
    lo[0] = o->hi[0] - 1.25 * o->length;
    hi[0] = o->hi[0];
    set = (int32_t)CALL(p, s, peri_select_box(o->body, "right", lo, hi));
    note_id(p, s, PERI_KIND_SET, set);
    if (set < 0) p->want = PERI_ERROR_ID_NONE;
    pull[kind / 4 % 2] = (kind / 8 % 2 ? 0.5 : 0.05) * (kind / 16 % 2 ? o->length : speed_of(o));
    note_id(p, s, PERI_KIND_LOAD, kind / 16 % 2 ? CALL(p, s, peri_prescribe_displacement(o->body, set, PERI_AXIS_XY, pull, NULL, NULL))
                                                : CALL(p, s, peri_prescribe_velocity(o->body, set, PERI_AXIS_XY, pull, NULL, NULL)));
    if (kind / 32 % 2) (void)cut(p, s);
}

/* Most programs begin with a body that is built, many with one that is held, too. */
static void make_scene(program *p) {
    const int kind = draw(p), shape = draw(p) % 16, held = draw(p), s = 0;
    p->mood = 0;
    p->nulls = p->iterations_left = -1;
    p->memory.fail_at = -1;
    if (kind % 16 == 0) return;
    (void)make_body(p, s);
    (void)add_material(p, s);
    if (kind % 16 == 1) return;
    if (kind % 16 < 5) (void)add_material(p, s);
    if (kind % 16 == 4) (void)set_interface(p, s);
    add_some_points(p, s, shape);
    if (kind % 16 == 2) return;
    if (build(p, s) != PERI_OK || points_of(&p->slots[s]) == 0) { /* an influence function that cannot be, a point alone, ... */
        peri_body_desc d;
        peri_material_desc m;
        slot *o = &p->slots[s];
        const double hi[3] = {6.0, 4.0, 2.0};
        drop(p, s);
        peri_body_desc_init(&d);
        d.space = PERI_SPACE_PLANE_STRESS + kind / 16 % 3;
        d.precision = kind / 64 < 3 ? PERI_PRECISION_DOUBLE : PERI_PRECISION_MIXED;
        d.horizon = 2.5;
        d.threads = 1;
        d.allocate = pool_allocate;
        d.release = pool_release;
        d.memory_user = &p->memory;
        o->space = d.space;
        o->dim = d.space == PERI_SPACE_SOLID ? 3 : 2;
        o->family = ++p->families;
        memcpy(o->hi, hi, sizeof hi);
        HOLDS(p, peri_body_create(&d, &o->body, &o->record) == PERI_OK);
        peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
        m.young = m.density = 1.0;
        m.critical_stretch = 0.02;
        note_id(p, s, PERI_KIND_MATERIAL, CALL(p, s, peri_add_material(o->body, &m)));
        HOLDS(p, CALL(p, s, peri_add_box(o->body, id_at(p, s, PERI_KIND_MATERIAL, 1), o->lo, o->hi, 1.0)) > 0);
        HOLDS(p, CALL(p, s, peri_build(o->body)) == PERI_OK);
    }
    if (held % 4) hold_scene(p, s, held / 4);
}

/* Runs a program; what did not hold is in p->fault. */
static void run_program(program *p, const uint8_t *bytes, size_t size, int trace) {
    int s;
    memset(p, 0, offsetof(program, in));
    p->at = bytes;
    p->end = bytes + size;
    p->trace = trace;
    for (s = 0; s < SLOTS; ++s) empty_slot(&p->slots[s]);
    make_scene(p);
    check_memory(p);
    check_body(p, 0);
    for (p->calls = 1; p->calls <= CALLS_MOST && p->at < p->end && !p->fault; ++p->calls) {
        s = draw(p) % 4 == 3 && (p->slots[1].body || draw(p) % 4 == 0);
        (void)one_call(p, s);
        check_body(p, s);
    }
    p->memory.fail_at = -1;
    for (s = 0; s < SLOTS && !p->fault; ++s)
        if (p->slots[s].body && size % 4 == 0) check_families(p, s);
    for (s = 0; s < SLOTS; ++s) peri_body_destroy(p->slots[s].body);
    drop_matrix(p);
    HOLDS(p, p->memory.blocks == 0 && p->memory.bytes == 0 && p->memory.wrong == 0);
}

#endif
