/* program_run.h - programs: the table of calls, and a whole life from its bytes. */
#ifndef PROGRAM_RUN_H
#define PROGRAM_RUN_H

#include "program_calls.h"

/* What NULL and unknown numbers are answered with. */
static int64_t ask_for_nothing(program *p, int s) {
    peri_memory m;
    (void)s;
    peri_body_desc_init(NULL);
    peri_material_init(NULL, 1);
    peri_run_init(NULL);
    peri_statics_init(NULL);
    peri_plan_desc_init(NULL);
    peri_body_destroy(NULL);
    peri_matrix_destroy(NULL);
    HOLDS(p, peri_status_text((int32_t)(draw(p) - 64)) != NULL);
    HOLDS(p, peri_error_format(NULL, NULL, 0) == PERI_ERROR_ARGUMENT && peri_read_memory(NULL, &m) == PERI_ERROR_ARGUMENT);
    HOLDS(p, peri_point_count(NULL) == PERI_ERROR_ARGUMENT && peri_time(NULL) == 0.0 && peri_stable_step(NULL) == 0.0);
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
};
#define TABLE ((int)(sizeof table / sizeof *table))

/* The first seven make things happen, and half of all calls are they. */
static int64_t one_call(program *p, int s) {
    const int which = draw(p), deep = p->calls % 3 == 0;
    const int k = which < 128 ? which % 7 : which % TABLE, level = p->level;
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
    if (status < 0 && !p->partial) {
        after = print_of(p, s, deep);
        if (!same_print(before, after, (int32_t)status)) blame(p, "a call that is refused changes nothing", __LINE__);
    }
    HOLDS(p, p->level == level);
    if (p->level == 0) check_memory(p);
    return status;
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
        s = draw(p) % 4 == 3;
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
