/* SPDX-License-Identifier: MIT */
/* test_promises_calls.c - the table "Calls and statuses" of docs/manual.md: each status that a row lists is one that the call can return,
   and calls return no others.

   SOURCE OF TRUTH: the table, which is read by calls_table.h. A pair of a call and a status is reached where a call of this file returns
   it, where one of the random programs does (program.h), or where a row of misuse.h or wrong_calls.h asks for it, which test_misuse.c and
   test_errors.c check; PERI_ERROR_LEFT_OUT where tests/switches.c asks for it. */
#include "calls_table.h"

/* ---- random programs ----------------------------------------------------------------------------------------------------------- */

#define PROGRAM_TOLD(text, status) reach((text), (status))
#include "program_corpus.h"
#include "program_run.h"

static program life;

static void run_programs(void) {
    static uint8_t bytes[4096];
    for (int k = 0; k < CORPUS; ++k) {
        size_t n = 0;
        unsigned value;
        while (sscanf(corpus[k] + 2 * n, "%2x", &value) == 1) bytes[n++] = (uint8_t)value;
        run_program(&life, bytes, n, 0);
        CHECK(life.fault == NULL);
    }
    for (uint64_t seed = 1; seed <= 500; ++seed) {
        uint64_t dice = seed * UINT64_C(0x9E3779B97F4A7C15);
        for (int k = 0; k < 200; ++k) bytes[k] = (uint8_t)(256.0 * test_random(&dice));
        run_program(&life, bytes, 200, 0);
        CHECK(life.fault == NULL);
    }
}

/* ---- calls --------------------------------------------------------------------------------------------------------------------- */

#define ASK(call) reach(#call, (int64_t)(call))

static int64_t fail_in = -1; /* allocations until one fails; negative: none does */
static void *take(void *user, uint64_t bytes) { return (void)user, fail_in >= 0 && fail_in-- == 0 ? NULL : malloc((size_t)bytes); }
static void give(void *user, void *pointer, uint64_t bytes) { (void)user, (void)bytes, free(pointer); }
static int32_t fail_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)time, (void)count, (void)points, (void)value;
    return -7;
}
static int32_t vast_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)time, (void)points;
    for (int64_t k = 0; k < count; ++k) value[k] = 1e300;
    return 0;
}
static peri_obstacle_state placed;
static int32_t fail_motion(void *user, double time, double *place, double *turn) {
    return (void)user, (void)time, (void)place, (void)turn, -7;
}
static int32_t fail_influence(void *user, double q, double *w) { return *w = 1, (void)q, *(int *)user; }
static int32_t no_influence(void *user, double q, double *w) { return (void)user, (void)q, *w = 0, 0; }
static int32_t bad_influence(void *user, double q, double *w) { return (void)user, (void)q, *w = (double)NAN, 0; }
static int32_t take_point(void *user, int64_t index, const double *x) { return (void)user, (void)index, (void)x, 1; }
static int32_t cut_none(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    return (void)user, (void)i, (void)j, (void)xi, (void)xj, 0;
}
static int32_t told_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    return (void)user, (void)i, (void)j, (void)time, (void)stretch, 0;
}
static int32_t take_bytes(void *user, const void *bytes, int64_t count) { return (void)bytes, (void)count, user != NULL; }

static int32_t no_bytes(void *user, void *bytes, int64_t count) { return (void)user, (void)bytes, (void)count, 1; }

static specimen plate_of(int32_t law) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 2.1, 12, 10, 1);
    s.desc.allocate = take;
    s.desc.release = give;
    return s;
}

static const double zero3[3] = {0, 0, 0}, one3[3] = {1, 0, 0}, up3[3] = {0, 1, 0}, far3[3] = {9, 9, 9}, nan3[3] = {(double)NAN, 0, 0};
static const int32_t two[2] = {0, 1};
static double numbers[512];
static int32_t ints[512];
static peri_material_desc stuff;
static peri_view view;
static peri_energy energy;
static peri_evaluate_desc forces;

#include "calls_parts.h"
/* Every function, without a body or a matrix. */
static void without_a_body(void) {
    const peri_body *c = NULL;
    peri_body *n = NULL, *made = NULL;
    peri_matrix *m = NULL;
    peri_memory memory;
    peri_error e;
    ASK(peri_unlock(n)), ASK(peri_get_error(c, &e)), ASK(peri_id(c, PERI_KIND_SET, 1)), ASK(peri_add_material(n, &stuff));
    ASK(peri_set_softening(n, 1, 2, NULL)), ASK(peri_get_softening(n, 1, 2, NULL, NULL)), ASK(peri_set_bond_law(n, 1, 2, 0, NULL, NULL));
    ASK(peri_set_interface(n, 1, 2, &stuff)), ASK(peri_get_bond_constants(n, 1, 2, NULL, NULL));
    ASK(peri_get_critical_energy(n, 1, numbers));
    ASK(peri_add_box(n, 1, zero3, far3, 1)), ASK(peri_add_ball(n, 1, zero3, 9, 1));
    ASK(peri_add_shape(n, 1, zero3, far3, 1, take_point, NULL));
    ASK(peri_add_perturbed_box(n, 1, zero3, far3, 1, 0.5, 1)), ASK(peri_add_points(n, 2, far3, one3, NULL));
    ASK(peri_set_families(n, 1, two));
    ASK(peri_build(n)), ASK(peri_get_families(n, 0, 1, ints, 512)), ASK(peri_bond_is_intact(n, 0, 1)), ASK(peri_reset(n));
    ASK(peri_select_box(n, NULL, zero3, far3)), ASK(peri_select_ball(n, NULL, zero3, 9)), ASK(peri_select_if(n, NULL, take_point, NULL));
    ASK(peri_select_points(n, NULL, 2, two)), ASK(peri_find_set(c, "a")), ASK(peri_size_of_set(c, 1)), ASK(peri_get_set(n, 1, ints, 512));
    ASK(peri_cut_segment(n, PERI_CUT_NOW, zero3, far3)), ASK(peri_cut_polyline(n, PERI_CUT_NOW, 2, numbers));
    ASK(peri_cut_disc(n, PERI_CUT_NOW, zero3, far3, 1)), ASK(peri_cut_triangle(n, PERI_CUT_NOW, zero3, far3, one3));
    ASK(peri_cut_rectangle(n, PERI_CUT_NOW, zero3, far3, one3)), ASK(peri_cut_pairs(n, PERI_CUT_NOW, 1, two));
    ASK(peri_cut_if(n, PERI_CUT_NOW, cut_none, NULL)), ASK(peri_set_no_fail(n, PERI_ALL, 1)), ASK(peri_on_break(n, NULL, NULL));
    ASK(peri_add_displacement(n, PERI_ALL, one3)), ASK(peri_add_velocity(n, PERI_ALL, one3));
    ASK(peri_prescribe_displacement(n, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL));
    ASK(peri_prescribe_velocity(n, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL)), ASK(peri_apply_body_force(n, PERI_ALL, one3, NULL, NULL));
    ASK(peri_apply_layer_traction(n, PERI_ALL, 1, one3, NULL, NULL)), ASK(peri_apply_traction(n, PERI_ALL, 1, one3, one3, NULL, NULL));
    ASK(peri_apply_pressure(n, PERI_ALL, 1, NULL, NULL)), ASK(peri_apply_bond_pressure_for_comparison(n, PERI_ALL, 1, NULL, NULL));
    ASK(peri_prescribe_rigid(n, PERI_ALL, zero3, NULL, NULL, NULL)), ASK(peri_get_reaction_moment(n, 1, zero3, numbers));
    ASK(peri_remove_load(n, 1)), ASK(peri_get_reaction(n, 1, numbers)), ASK(plane_obstacle(n, zero3, up3, 0, NULL, NULL));
    ASK(ball_obstacle(n, zero3, 1, 0, NULL, NULL)), ASK(peri_remove_obstacle(n, 1)), ASK(peri_get_obstacle_force(n, 1, numbers, NULL));
    ASK(peri_get_obstacle_state(n, 1, &placed)), ASK(peri_set_obstacle_state(n, 1, &placed));
    ASK(peri_set_contact(n, 1, 1, NULL));
    ASK(peri_save_state_to(n, take_bytes, NULL)), ASK(peri_save_state(n, "build/x")), ASK(peri_load_state(n, "build/x"));
    ASK(peri_load_state_from(n, no_bytes, NULL));
    ASK(peri_evaluate(n, NULL, NULL)), ASK(peri_multiply_stiffness_at(n, numbers, numbers, numbers, 2));
    ASK(peri_multiply_stiffness(n, numbers, numbers, 2)), ASK(peri_matrix_create(n, &m)), ASK(peri_matrix_rows(m));
    ASK(peri_matrix_entries(m)), with_cracks(n, n);
    ASK(peri_get_matrix(m, NULL, NULL, NULL)), ASK(peri_export_matrix_to(m, take_bytes, NULL));
    ASK(peri_size_of_field(c, PERI_FIELD_VOLUME));
    ASK(peri_get_field(n, PERI_FIELD_VOLUME, numbers, 512)), ASK(peri_set_field(n, PERI_FIELD_VELOCITY, numbers, 512));
    ASK(peri_view_field(n, PERI_FIELD_VOLUME, &view)), ASK(peri_get_energy(n, &energy)), ASK(peri_get_momentum(n, numbers, NULL));
    ASK(peri_export_vtu_to(n, take_bytes, NULL)), ASK(peri_export_history_to(n, 1, take_bytes, NULL)), ASK(peri_export_vtu(n, "build/x"));
    ASK(peri_export_history(n, "build/x", 0)), ASK(peri_get_memory(c, &memory)), ASK(peri_format_error(NULL, NULL, 0));
    ASK(peri_plan(NULL, NULL, NULL)), ASK(peri_choose(NULL, NULL, NULL, NULL, NULL)), ASK(peri_body_create(NULL, &made, NULL));
    ASK(peri_body_clone(n, &made, NULL)), ASK(peri_advance(n, NULL)), ASK(peri_solve(n, NULL, NULL));
    ask_of_pieces(n, zero3);
}

/* Ids: none, of another kind, of another body, gone. */
static void with_wrong_ids(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED);
    s.desc.number = 1;
    peri_body *b = specimen_make(&s), *draft = specimen_start(&s), *other;
    s.desc.number = 2;
    other = specimen_make(&s);
    peri_solve_desc st;
    peri_solve_desc_init(&st);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1), draft_material = peri_id(draft, PERI_KIND_MATERIAL, 1);
    const int32_t set = (int32_t)MUST(b, peri_select_ball(b, NULL, zero3, 9)),
        theirs = (int32_t)MUST(other, peri_select_ball(other, NULL, zero3, 9));
    const int32_t their_load = (int32_t)MUST(other, peri_apply_body_force(other, PERI_ALL, one3, NULL, NULL));
    const int32_t their_wall = (int32_t)MUST(other, plane_obstacle(other, zero3, up3, 0, NULL, NULL));
    const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, NULL, NULL));
    const int32_t wall = (int32_t)MUST(b, plane_obstacle(b, zero3, up3, 0, NULL, NULL));
    const int32_t sets[4] = {3, material, theirs, set + 50}, loads[4] = {3, set, their_load, load + 50};
    const int32_t walls[4] = {3, set, their_wall, wall + 50};
    peri_obstacle_desc ball;
    peri_obstacle_desc_init(&ball, PERI_SHAPE_BALL);
    ball.radius = ball.mass = 1;
    const int32_t stone = (int32_t)MUST(b, peri_add_obstacle(b, &ball));
    placed.velocity[0] = HUGE_VAL;
    ASK(peri_set_obstacle_state(b, stone, &placed)), ASK(peri_set_obstacle_state(b, stone, NULL));
    placed.velocity[0] = 0;
    const int32_t materials[4] = {3, PERI_ALL, peri_id(other, PERI_KIND_MATERIAL, 1), material + 50};
    for (int k = 0; k < 4; ++k) {
        const int32_t m = materials[k], i = sets[k], l = loads[k], w = walls[k], of_points[2] = {m, m};
        ASK(peri_set_interface(draft, m, draft_material, &stuff)), ASK(peri_get_bond_constants(b, m, material, NULL, NULL));
        ASK(peri_get_critical_energy(b, m, numbers)), ASK(peri_add_box(draft, m, zero3, far3, 1));
        ASK(peri_add_ball(draft, m, zero3, 9, 1));
        ASK(peri_add_shape(draft, m, zero3, far3, 1, take_point, NULL)), ASK(peri_add_perturbed_box(draft, m, zero3, far3, 1, 0.5, 1));
        ASK(peri_add_points(draft, 1, far3, one3, of_points)), ASK(peri_size_of_set(b, i)), ASK(peri_get_set(b, i, ints, 512));
        ASK(peri_set_no_fail(b, i, 1)), ASK(peri_add_displacement(b, i, one3)), ASK(peri_add_velocity(b, i, one3));
        ASK(peri_prescribe_displacement(b, i, PERI_AXIS_X, NULL, NULL, NULL));
        ASK(peri_prescribe_velocity(b, i, PERI_AXIS_X, NULL, NULL, NULL));
        ASK(peri_apply_body_force(b, i, one3, NULL, NULL)), ASK(peri_apply_layer_traction(b, i, 1, one3, NULL, NULL));
        ASK(peri_apply_traction(b, i, 1, one3, one3, NULL, NULL)), ASK(peri_apply_pressure(b, i, 1, NULL, NULL));
        ASK(peri_apply_bond_pressure_for_comparison(b, i, 1, NULL, NULL)), ASK(peri_remove_load(b, l));
        ASK(peri_get_reaction(b, l, numbers)), ASK(peri_get_reaction_moment(b, l, zero3, numbers));
        ASK(peri_remove_obstacle(b, w)), ASK(peri_get_obstacle_force(b, w, numbers, NULL));
        ASK(peri_get_obstacle_state(b, w, &placed)), ASK(peri_set_obstacle_state(b, w, &placed));
        ASK(peri_set_contact(b, k == 1 ? set : m, material, NULL));
        st.curve_load = l;
        st.curve = numbers;
        st.curve_rows = 1;
        ASK(peri_solve(b, &st, NULL));
        ASK(peri_advance_implicit(b, steps_in_time(1), &st, 1.0, NULL));
    }
    peri_body_destroy(b);
    peri_body_destroy(draft);
    peri_body_destroy(other);
}

/* Too early, and too late. */
static void at_the_wrong_time(void) {
    const specimen s = plate_of(PERI_LAW_BOND_BASED);
    peri_body *d = specimen_start(&s), *b = specimen_make(&s);
    peri_matrix *m = NULL;
    const int32_t id = peri_id(b, PERI_KIND_MATERIAL, 1);
    specimen pole = s;
    ASK(peri_get_families(d, 0, 1, ints, 512)), ASK(peri_bond_is_intact(d, 0, 1)), ASK(peri_select_ball(d, NULL, zero3, 9));
    ASK(peri_select_if(d, NULL, take_point, NULL)), ASK(peri_select_points(d, NULL, 2, two)), ASK(peri_get_set(d, PERI_ALL, ints, 512));
    ASK(peri_set_no_fail(d, PERI_ALL, 1)), ASK(peri_on_break(d, NULL, NULL)), with_cracks(d, d);
    ASK(peri_apply_layer_traction(d, PERI_ALL, 1, one3, NULL, NULL));
    ASK(peri_apply_traction(d, PERI_ALL, 1, one3, one3, NULL, NULL)), ASK(peri_remove_load(d, 1)), ASK(peri_remove_obstacle(d, 1));
    ASK(peri_apply_bond_pressure_for_comparison(d, PERI_ALL, 1, NULL, NULL)), ASK(peri_get_reaction(d, 1, numbers));
    ASK(peri_prescribe_rigid(d, PERI_ALL, zero3, NULL, NULL, NULL)), ASK(peri_get_reaction_moment(d, 1, zero3, numbers));
    ASK(peri_get_obstacle_state(d, 1, &placed)), ASK(peri_set_obstacle_state(d, 1, &placed));
    ASK(peri_get_obstacle_force(d, 1, numbers, NULL)), ASK(peri_matrix_create(d, &m)), ASK(peri_size_of_field(d, PERI_FIELD_VOLUME));
    ASK(peri_set_field(d, PERI_FIELD_VELOCITY, numbers, 512)), ASK(peri_view_field(d, PERI_FIELD_VOLUME, &view));
    ASK(peri_get_energy(d, &energy));
    ASK(peri_get_momentum(d, numbers, NULL)), ASK(peri_export_vtu_to(d, take_bytes, NULL)), ASK(peri_export_vtu(d, "build/x"));
    ASK(peri_export_history_to(d, 1, take_bytes, NULL)), ASK(peri_export_history(d, "build/x", 0));
    ASK(peri_add_ball(b, id, zero3, 9, 1)), ASK(peri_add_perturbed_box(b, id, zero3, far3, 1, 0.5, 1));
    ASK(peri_add_points(b, 1, far3, one3, NULL)), ask_of_pieces(d, zero3);
    pole.desc.influence = PERI_INFLUENCE_POLE_EDGE;
    peri_body_destroy(d);
    d = specimen_start(&pole);
    ASK(peri_get_bond_constants(d, peri_id(d, PERI_KIND_MATERIAL, 1), peri_id(d, PERI_KIND_MATERIAL, 1), numbers, NULL));
    peri_body_destroy(d);
    peri_body_destroy(b);
}

/* What is missing, empty, out of range, too long or left by a callback. */
static void with_wrong_arguments(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED), solid = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 2.1, 5, 4, 4);
    peri_body *b = specimen_make(&s), *d = specimen_start(&s), *t = specimen_make(&solid);
    const int32_t id = peri_id(d, PERI_KIND_MATERIAL, 1), second = (int32_t)MUST(d, peri_add_material(d, &s.material));
    const double nothing[2] = {0, 0};
    peri_material_desc m = s.material;
    peri_matrix *matrix = NULL;
    stuff = s.material;
    ASK(peri_add_box(d, id, NULL, far3, 1)), ASK(peri_set_interface(d, id, second, NULL)), ASK(peri_get_critical_energy(d, id, NULL));
    ASK(peri_add_points(d, 0, far3, one3, NULL)), ASK(peri_add_points(d, 1, far3, one3, NULL));
    ASK(peri_add_points(d, 1, far3, nothing, &id));
    ASK(peri_add_points(d, INT64_C(3000000000), numbers, numbers, ints)), ASK(peri_set_families(d, 2, two));
    ASK(peri_set_families(d, 0, two));
    ASK(peri_add_shape(d, id, zero3, nan3, 1, take_point, NULL)), ASK(peri_add_ball(d, id, zero3, 1e9, 1e-3));
    m.cookie = 0, ASK(peri_set_interface(d, id, second, &m)), m = s.material;
    m.law = 7, ASK(peri_set_interface(d, id, second, &m)), m = s.material;
    m.poisson = 0.1, ASK(peri_set_interface(d, id, second, &m)), m = s.material;
    m.criterion = PERI_CRITERION_BOND_ENERGY, m.fracture_energy = 1, ASK(peri_set_interface(d, id, second, &m));
    ASK(peri_add_material(d, &m)), m = s.material;
    m.bulk = 1, ASK(peri_set_interface(d, id, second, &m)), m.bulk = 0, m.young = -1, ASK(peri_set_interface(d, id, second, &m));
    ASK(peri_select_points(b, NULL, 0, two)), ASK(peri_select_points(b, NULL, 2, NULL)), ASK(peri_select_box(b, NULL, nan3, far3));
    MUST(b, peri_select_ball(b, "a", zero3, 9)), ASK(peri_select_ball(b, "a", zero3, 9)), ASK(peri_select_if(b, "a", take_point, NULL));
    ASK(peri_cut_disc(t, PERI_CUT_NOW, nan3, up3, 1)), ASK(peri_cut_triangle(t, PERI_CUT_NOW, nan3, up3, one3));
    ASK(peri_cut_rectangle(t, PERI_CUT_NOW, nan3, up3, one3)), ASK(peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_X, nan3, NULL, NULL));
    ASK(peri_apply_traction(b, PERI_ALL, -1, one3, one3, NULL, NULL)), ASK(peri_apply_pressure(b, PERI_ALL, HUGE_VAL, NULL, NULL));
    ASK(peri_apply_bond_pressure_for_comparison(b, PERI_ALL, HUGE_VAL, NULL, NULL)), ASK(peri_multiply_stiffness(b, NULL, numbers, 240));
    ASK(peri_multiply_stiffness(b, numbers, numbers, 3)), ASK(peri_multiply_stiffness_at(b, numbers, numbers, numbers, 3));
    peri_evaluate_desc_init(&forces), forces.nodal = 2, ASK(peri_evaluate(b, &forces, NULL));
    forces.cookie = 1, ASK(peri_evaluate(b, &forces, NULL)), peri_evaluate_desc_init(&forces);
    forces.time_step = -1, ASK(peri_evaluate(b, &forces, NULL));
    numbers[0] = (double)NAN, ASK(peri_multiply_stiffness(b, numbers, numbers, 240));
    ASK(peri_multiply_stiffness_at(b, numbers, numbers, numbers, 240));
    ASK(peri_matrix_create(b, NULL)), MUST(b, peri_matrix_create(b, &matrix)), ASK(peri_export_matrix_to(matrix, NULL, NULL));
    ASK(peri_export_matrix_to(matrix, take_bytes, b)), ASK(peri_export_history_to(b, 1, NULL, NULL)), ASK(peri_export_history(b, NULL, 0));
    peri_matrix_destroy(matrix);
    with_cracks(b, NULL);
    peri_body_destroy(d);
    ask_of_pieces(b, zero3), ask_of_pieces(b, zero3), ask_of_pieces(b, nan3);
    numbers[0] = 0;
    const double beyond[4] = {-1.7e308, 0, 1.7e308, 0}, units[2] = {1, 1};
    d = NULL;
    MUST(NULL, peri_body_create(&s.desc, &d, NULL)), ASK(peri_add_points(d, 1, far3, one3, NULL));
    peri_body_destroy(d);
    d = specimen_start(&s);
    MUST(d, peri_add_points(d, 2, beyond, units, NULL)), ASK(peri_build(d)); /* an extent that is no number */
    peri_body_destroy(d);
    s.desc.horizon = 2e140; /* whose units leave 1e250 */
    d = specimen_start(&s);
    MUST(d, peri_add_box(d, peri_id(d, PERI_KIND_MATERIAL, 1), zero3, (const double[2]){4e140, 4e140}, 1e140)), ASK(peri_build(d));
    peri_body_destroy(d);
    s.desc.horizon = 1e-80; /* constants that leave the range of double */
    s.desc.space = PERI_SPACE_SOLID;
    d = specimen_start(&s);
    ASK(peri_get_bond_constants(d, peri_id(d, PERI_KIND_MATERIAL, 1), peri_id(d, PERI_KIND_MATERIAL, 1), numbers, NULL));
    peri_body_destroy(d);
    s.material.law = PERI_LAW_LPS;
    s.material.poisson = 0.2;
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    s.material.fracture_energy = 1;
    d = specimen_start(&s);
    ASK(peri_get_critical_energy(d, peri_id(d, PERI_KIND_MATERIAL, 1), numbers));
    peri_body_destroy(d);
    s.material.criterion = PERI_CRITERION_NODE_ENERGY;
    d = specimen_start(&s);
    ASK(peri_get_critical_energy(d, peri_id(d, PERI_KIND_MATERIAL, 1), numbers));
    peri_body_destroy(d);
    peri_body_destroy(b);
    peri_body_destroy(t);
}

/* Callbacks that fail, and loads beyond the precision. */
static void with_failing_callbacks(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED);
    double f[512] = {0};
    int said = 0;
    peri_error e;
    for (int way = 0; way < 2; ++way) {
        s.desc.precision = PERI_PRECISION_SINGLE;
        peri_body *b = specimen_make(&s);
        const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, way ? vast_load : fail_load, NULL));
        const int32_t wall = (int32_t)MUST(b, plane_obstacle(b, (const double[2]){0, -9}, up3, 1, way ? NULL : fail_motion, NULL));
        ASK(peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 512)), ASK(peri_view_field(b, PERI_FIELD_FORCE_DENSITY, &view));
        ASK(peri_get_reaction(b, load, f)), ASK(peri_get_reaction_moment(b, load, zero3, f));
        ASK(peri_get_obstacle_force(b, wall, f, NULL)), ASK(peri_get_obstacle_state(b, wall, &placed));
        ASK(peri_multiply_stiffness(b, f, f, 240));
        peri_evaluate_desc_init(&forces), ASK(peri_evaluate(b, &forces, NULL));
        peri_body_destroy(b);
    }
    s.desc.precision = PERI_PRECISION_DOUBLE;
    s.desc.influence = PERI_INFLUENCE_USER;
    s.desc.influence_fn = fail_influence;
    s.desc.influence_user = &said;
    peri_body *d = specimen_start(&s);
    const int32_t id = peri_id(d, PERI_KIND_MATERIAL, 1);
    peri_plan_desc p;
    peri_plan_report report;
    MUST(d, peri_add_box(d, id, zero3, far3, 1));
    peri_plan_desc_init(&p);
    p.body = &s.desc;
    p.material = &s.material;
    p.spacing = 1;
    p.hi[0] = p.hi[1] = 9;
    said = -7;
    ASK(peri_build(d)), ASK(peri_get_bond_constants(d, id, id, f, NULL)), ASK(peri_plan(&p, &report, &e));
    peri_body_destroy(d);
    for (int k = 0; k < 2; ++k) {
        s.desc.influence_fn = k ? bad_influence : no_influence;
        d = specimen_start(&s);
        ASK(peri_get_bond_constants(d, peri_id(d, PERI_KIND_MATERIAL, 1), peri_id(d, PERI_KIND_MATERIAL, 1), f, NULL));
        ASK(peri_plan(&p, &report, &e));
        s.material.law = PERI_LAW_LPS;
        s.material.poisson = 0.2;
        ASK(peri_plan(&p, &report, &e));
        s.material.law = PERI_LAW_BOND_BASED;
        s.material.poisson = (double)NAN;
        peri_body_destroy(d);
    }
}

/* The next allocation fails. */
#define SHORT(call) (fail_in = 0, ASK(call), fail_in = -1)
#include "calls_laws.h"
#include "calls_results.h"
static void without_memory(void) {
    specimen s = plate_of(PERI_LAW_LPS), solid = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 2.1, 5, 4, 4);
    solid.desc.allocate = take;
    solid.desc.release = give;
    fail_in = -1;
    peri_body *b = specimen_make(&s), *t = specimen_make(&solid), *made = NULL;
    peri_matrix *m = NULL;
    peri_cracks *cracks = NULL;
    peri_cracks_desc desc;
    peri_memory before, after;
    peri_advance_desc one_step;
    const double corner[3] = {-1, -1, 2}, along[3] = {9, 0, 0}, across[3] = {0, 9, 0}, wall[2] = {0, -9};
    peri_advance_desc_init(&one_step), one_step.steps = 1;
    CHECK(peri_get_memory(b, &before) == PERI_OK);
    SHORT(peri_body_create(&s.desc, &made, NULL)), SHORT(peri_body_clone(b, &made, NULL));
    SHORT(peri_select_box(b, NULL, zero3, far3)), SHORT(peri_select_ball(b, NULL, zero3, 9));
    SHORT(peri_select_if(b, NULL, take_point, NULL));
    SHORT(peri_select_points(b, NULL, 2, two)), SHORT(peri_cut_segment(b, PERI_CUT_INITIAL, zero3, far3));
    SHORT(peri_cut_polyline(b, PERI_CUT_INITIAL, 2, (const double[4]){0, 0, 9, 9})), SHORT(peri_cut_pairs(b, PERI_CUT_INITIAL, 1, two));
    SHORT(peri_cut_if(b, PERI_CUT_INITIAL, cut_none, NULL)), SHORT(peri_cut_disc(t, PERI_CUT_INITIAL, corner, across, 9));
    SHORT(peri_cut_triangle(t, PERI_CUT_INITIAL, corner, along, across));
    SHORT(peri_cut_rectangle(t, PERI_CUT_INITIAL, corner, along, across));
    SHORT(peri_set_no_fail(b, PERI_ALL, 1)), SHORT(peri_on_break(b, told_break, NULL));
    peri_cracks_desc_init(&desc);
    SHORT(peri_record_breaks(b, 1)), SHORT(peri_cracks_create(b, &desc, &cracks));
    SHORT(peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL));
    SHORT(peri_prescribe_rigid(b, PERI_ALL, zero3, NULL, NULL, NULL));
    SHORT(peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, NULL, NULL, NULL)), SHORT(peri_apply_body_force(b, PERI_ALL, one3, NULL, NULL));
    SHORT(peri_apply_layer_traction(b, PERI_ALL, 1, one3, NULL, NULL)), SHORT(peri_apply_pressure(b, PERI_ALL, 1, NULL, NULL));
    const int32_t face = (int32_t)MUST(b, peri_select_box(b, NULL, (const double[2]){7.5, 0}, (const double[2]){12, 10}));
    SHORT(peri_apply_traction(b, face, 10, one3, one3, NULL, NULL));
    SHORT(peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1, NULL, NULL));
    peri_obstacle_desc plane;
    peri_obstacle_desc_init(&plane, PERI_SHAPE_PLANE);
    plane.place[1] = wall[1];
    plane.normal[1] = 1;
    SHORT(peri_add_obstacle(b, &plane)), SHORT(ball_obstacle(b, wall, 1, 0, NULL, NULL));
    SHORT(peri_save_state_to(b, take_bytes, NULL)), SHORT(peri_save_state(b, "build/short.state"));
    MUST(b, peri_save_state(b, "build/short.state")), SHORT(peri_load_state(b, "build/short.state"));
    SHORT(peri_load_state_from(b, no_bytes, NULL));
    SHORT(peri_evaluate(b, &forces, NULL)), SHORT(peri_multiply_stiffness_at(b, numbers, numbers, numbers, 240));
    SHORT(peri_multiply_stiffness(b, numbers, numbers, 240)), SHORT(peri_matrix_create(b, &m));
    SHORT(peri_view_field(b, PERI_FIELD_DAMAGE, &view)), SHORT(peri_advance(b, &one_step));
    SHORT(peri_export_vtu_to(b, take_bytes, NULL)), SHORT(peri_export_vtu(b, "build/short.vtu"));
    peri_contact_desc touch;
    peri_contact_desc_init(&touch);
    SHORT(peri_set_contact(b, PERI_ALL, PERI_ALL, &touch)); /* whose lists forces and energies are made with */
    for (int k = 0; k < 7; ++k) {
        const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, NULL, NULL));
        const int32_t wall_of = (int32_t)MUST(b, plane_obstacle(b, wall, up3, 0, NULL, NULL));
        MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &touch));
        if (k == 0) SHORT(peri_get_field(b, PERI_FIELD_FORCE_DENSITY, numbers, 512));
        if (k == 1) SHORT(peri_get_reaction(b, load, numbers));
        if (k == 6) SHORT(peri_get_reaction_moment(b, load, zero3, numbers));
        if (k == 2) SHORT(peri_get_obstacle_force(b, wall_of, numbers, NULL)), SHORT(peri_get_obstacle_state(b, wall_of, &placed));
        if (k == 3) SHORT(peri_get_energy(b, &energy));
        if (k == 4) SHORT(peri_export_history_to(b, 0, take_bytes, NULL));
        if (k == 5) SHORT(peri_export_history(b, "build/short.csv", 0));
        MUST(b, peri_remove_load(b, load)), MUST(b, peri_remove_obstacle(b, wall_of));
        MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    }
    static peri_fragment pieces[256];
    int64_t count[2];
    SHORT(peri_find_fragments(b, ints, 512)), SHORT(peri_get_fragments(b, pieces, 256));
    SHORT(peri_get_field(b, PERI_FIELD_FRAGMENT, numbers, 512));
    SHORT(peri_size_of_outline(b, -1, count, count + 1)), SHORT(peri_get_outline(b, -1, numbers, 4, ints, NULL, NULL, 4));
    SHORT(peri_select_box_in_place(b, NULL, zero3, far3)), SHORT(peri_select_ball_in_place(b, NULL, zero3, 9));
    CHECK(peri_get_memory(b, &after) == PERI_OK && after.state == before.state && after.fields == before.fields);
    CHECK(made == NULL && m == NULL);
    peri_body_destroy(t);
    peri_body_destroy(b);
    s = plate_of(PERI_LAW_BOND_BASED);
    b = specimen_start(&s);
    const int32_t id = peri_id(b, PERI_KIND_MATERIAL, 1), second = (int32_t)MUST(b, peri_add_material(b, &s.material));
    int32_t rows[120 * 2];
    for (int k = 0; k < 240; ++k) rows[k] = k / 2;
    SHORT(peri_set_interface(b, id, second, &s.material)), SHORT(peri_add_box(b, id, zero3, far3, 1));
    SHORT(peri_add_ball(b, id, zero3, 9, 1));
    SHORT(peri_add_shape(b, id, zero3, far3, 1, take_point, NULL)), SHORT(peri_add_perturbed_box(b, id, zero3, far3, 1, 0.5, 1));
    SHORT(peri_add_points(b, 1, far3, one3, &id)), MUST(b, peri_add_box(b, id, s.lo, s.hi, 1)), SHORT(peri_set_families(b, 2, rows));
    SHORT(peri_build(b));
    peri_body_destroy(b);
}

/* Plans and choices. */
static void with_wrong_plans(void) {
    specimen s = plate_of(PERI_LAW_LPS);
    peri_plan_desc p;
    peri_plan_report r;
    peri_choose_desc g;
    peri_choose_report c;
    peri_error e;
    peri_body_desc body;
    peri_material_desc m;
#define GOOD()                                                                                                         \
    (peri_plan_desc_init(&p), s = plate_of(PERI_LAW_LPS), p.body = &s.desc, p.material = &s.material, p.spacing = 1,   \
     p.hi[0] = p.hi[1] = 9, peri_choose_desc_init(&g), g.preset = PERI_PRESET_TEACHING,                                \
     g.quantity = PERI_QUANTITY_DEFORMATION, g.feature = g.hi[0] = g.hi[1] = 9)
#define WRONG(change)                                                                                                  \
    (GOOD(), (void)(change), ASK(peri_plan(&p, &r, &e)), m = s.material, body = s.desc, ASK(peri_choose(&g, &body, &m, &c, &e)))
    WRONG((p.cookie = 1, g.cookie = 1)), WRONG(s.material.young = 0), WRONG(s.material.criterion = PERI_CRITERION_BOND_ENERGY);
    WRONG(s.material.stabilization = 1), WRONG((s.material.law = PERI_LAW_BOND_BASED, s.material.poisson = 0.1));
    WRONG((p.spacing = 1e-9, g.feature = 1e-300)), WRONG(s.desc.horizon = 0.5), WRONG((p.hi[0] = p.hi[1] = 1, g.hi[0] = g.hi[1] = 1e-9));
    WRONG((p.measure = 1, fail_in = 0, g.seconds = 1));
    fail_in = -1;
    WRONG((g.seconds = 1e-3, fail_in = 0, g.preset = PERI_PRESET_NONE));
    fail_in = -1;
    WRONG((p.body = NULL, s.desc.space = 0)), WRONG((p.hi[0] = p.hi[1] = 0.5));
    GOOD(), s.material.law = PERI_LAW_BOND_BASED, s.material.poisson = (double)NAN, s.desc.influence = PERI_INFLUENCE_INVERSE_4;
    ASK(peri_plan(&p, &r, &e));
}

/* As many sets as there can be; of loads and obstacles with --long: they take 400 MB. */
static void fill_sets(peri_body *b) {
    const int32_t point = 7;
    int32_t last = 0;
    while (last >= 0) last = peri_select_points(b, NULL, 1, &point);
    ASK(peri_select_box_in_place(b, NULL, zero3, far3)), ASK(peri_select_ball_in_place(b, NULL, zero3, 9));
    ASK(peri_select_points(b, NULL, 1, &point)), ASK(peri_select_box(b, NULL, zero3, far3)), ASK(peri_select_ball(b, NULL, zero3, 9));
    ASK(peri_select_if(b, NULL, take_point, NULL));
}
static void fill_loads(peri_body *b) {
    const int32_t point = 7, set = (int32_t)MUST(b, peri_select_points(b, NULL, 1, &point));
    const int32_t face = (int32_t)MUST(b, peri_select_box(b, NULL, (const double[2]){7.5, 0}, (const double[2]){12, 10}));
    int32_t last = 0;
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, (const double[2]){6, -1}, (const double[2]){6, 5}));
    while (last >= 0) last = peri_apply_body_force(b, set, zero3, NULL, NULL);
    ASK(peri_apply_body_force(b, set, zero3, NULL, NULL)), ASK(peri_apply_layer_traction(b, set, 1, zero3, NULL, NULL));
    ASK(peri_prescribe_displacement(b, set, PERI_AXIS_X, NULL, NULL, NULL));
    ASK(peri_prescribe_velocity(b, set, PERI_AXIS_X, NULL, NULL, NULL));
    ASK(peri_prescribe_rigid(b, set, zero3, NULL, NULL, NULL));
    ASK(peri_apply_pressure(b, PERI_ALL, 1, NULL, NULL)), ASK(peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1, NULL, NULL));
    ASK(peri_apply_traction(b, face, 10, one3, one3, NULL, NULL));
    for (last = 0; last >= 0;) last = plane_obstacle(b, zero3, up3, 1e-9, NULL, NULL);
    peri_obstacle_desc ball;
    peri_obstacle_desc_init(&ball, PERI_SHAPE_BALL);
    ball.place[1] = 1e3;
    ball.radius = 1;
    ASK(peri_add_obstacle(b, &ball));
}

/* A tangent that is not positive: nearest neighbours that push. */
static int32_t pushing(void *user, double q, double *w) { return *w = 1 - 13 * pow(1 - q, 4), (void)user, 0; }
static void with_a_bad_tangent(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED);
    peri_solve_desc st;
    peri_solve_desc_init(&st);
    s.desc.horizon = 3;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.influence = PERI_INFLUENCE_USER;
    s.desc.influence_fn = pushing;
    peri_body *b = specimen_make(&s);
    const int32_t left = (int32_t)MUST(b, peri_select_box(b, NULL, zero3, (const double[2]){3, 10}));
    MUST(b, peri_prescribe_displacement(b, left, PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, one3, NULL, NULL));
    ASK(peri_solve(b, &st, NULL));
    ASK(peri_advance_implicit(b, steps_in_time(1e9), &st, 1.0, NULL));
    peri_body_destroy(b);
}

/* ---- cases --------------------------------------------------------------------------------------------------------------------- */

static int is_out_of_reach(int call, int status) {
    const char *name = table_rows[call].name;
    if (status != of_status(PERI_ERROR_TOO_LARGE)) return 0;
    if (strcmp(name, "peri_solve") == 0 || strcmp(name, "peri_matrix_create") == 0) return 1; /* a matrix of 2^31 blocks: some 100 GB */
    if (test_long) return 0;
    return strncmp(name, "peri_apply", 10) == 0 || strncmp(name, "peri_prescribe", 14) == 0 || strstr(name, "_obstacle") != NULL;
}

static void gather(void) {
    const specimen s = plate_of(PERI_LAW_BOND_BASED);
    fail_in = -1;
    read_names();
    read_table();
    read_refusals("tests/misuse.h", ", ");
    read_refusals("tests/wrong_calls.h", "PERI_ERROR_");
    read_left_out();
    run_programs();
    stuff = s.material;
    without_a_body();
    with_wrong_ids();
    at_the_wrong_time();
    with_fields(), with_evaluations(), with_implicit_steps(), with_parts(), with_worlds(), with_cells(), with_results();
    with_wrong_laws();
    with_wrong_arguments();
    with_failing_callbacks();
    without_memory();
    with_wrong_plans();
    with_a_bad_tangent();
    peri_body *b = specimen_make(&s);
    fill_sets(b);
    peri_body_destroy(b);
    if (!test_long) return;
    specimen of_springs = s;
    of_springs.material = plate_of(PERI_LAW_CORRESPONDENCE).material;
    b = specimen_make(&of_springs);
    fill_loads(b);
    peri_body_destroy(b);
}

static void pairs_of_the_table_are_reached(void) {
    int pairs = 0;
    gather();
    for (int k = 0; k < calls_of_table; ++k)
        for (int s = 0; s < STATUSES; ++s) {
            pairs += table_rows[k].listed[s];
            if (!table_rows[k].listed[s] || table_rows[k].reached[s] || is_out_of_reach(k, s)) continue;
            test_bad++;
            printf("    %s never returns %s\n", table_rows[k].name, name_of(s));
        }
    printf("    %d calls, %d pairs\n", calls_of_table, pairs);
    CHECK(pairs > 450);
}
static void no_others_are(void) {
    for (int k = 0; k < calls_of_table; ++k)
        for (int s = 0; s < STATUSES; ++s)
            if (table_rows[k].reached[s] && (table_rows[k].never || !table_rows[k].listed[s])) {
                test_bad++;
                printf("    %s returns %s, which the table has not\n", table_rows[k].name, name_of(s));
            }
}
/* "never", "never: 0 (or "") for NULL". */
static void never_where_it_says_so(void) {
    int never = 0;
    for (int k = 0; k < calls_of_table; ++k) never += table_rows[k].never;
    CHECK(never == 2 + 13 + 4 + 12 + 1 + 1 + 1);
    CHECK(peri_version() > 0 && peri_status_text(12345)[0] != 0);
    peri_body_destroy(NULL);
    peri_matrix_destroy(NULL);
    peri_cracks_destroy(NULL), peri_world_destroy(NULL);
    CHECK(peri_cracks_size(NULL) == 0 && peri_world_stable_step(NULL) == 0);
    CHECK(peri_dimension(NULL) == 0 && peri_point_count(NULL) == 0 && peri_family_width(NULL) == 0 && peri_bond_count(NULL) == 0);
    CHECK(peri_entry_count(NULL) == 0 && peri_cut_count(NULL) == 0 && peri_broken_count(NULL) == 0 && peri_step_count(NULL) == 0);
    CHECK(peri_time(NULL) == 0 && peri_load_factor(NULL) == 0 && peri_kernel_text(NULL)[0] == 0 && peri_stable_step(NULL) == 0);
}
/* "RANGE of calls that read forces comes from a load whose force density is beyond the precision." */
static void range_of_calls_that_read_forces(void) {
    for (int32_t p = PERI_PRECISION_DOUBLE; p <= PERI_PRECISION_SINGLE; ++p) {
        specimen s = plate_of(PERI_LAW_BOND_BASED);
        double f[512];
        const int32_t want = p == PERI_PRECISION_SINGLE ? PERI_ERROR_RANGE : PERI_OK;
        s.desc.precision = p;
        peri_body *b = specimen_make(&s);
        const int32_t load = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, vast_load, NULL));
        CHECK(peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 512) == want && peri_get_reaction(b, load, f) == want);
        CHECK(peri_view_field(b, PERI_FIELD_FORCE_DENSITY, &view) == want);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(pairs_of_the_table_are_reached);
    if (!test_filter) RUN(no_others_are); /* of what the case above has reached */
    if (!test_filter) RUN(never_where_it_says_so);
    RUN(range_of_calls_that_read_forces);
    return test_end("test_promises_calls");
}
