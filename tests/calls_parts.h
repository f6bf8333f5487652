/* SPDX-License-Identifier: MIT */
/* calls_parts.h - of test_promises_calls.c, whose names it uses: what cracks as paths, peri_evaluate and checkpoints refuse. */
#ifndef CALLS_PARTS_H
#define CALLS_PARTS_H

/* What asks for cracks, of a body that has none or of one that is: then by what is wrong beside. */
static void with_cracks(peri_body *b, const peri_body *unbuilt) {
    peri_cracks *cracks = NULL;
    peri_cracks_desc desc;
    peri_cracks_desc_init(&desc);
    if (unbuilt || !b) {
        ASK(peri_record_breaks(b, 1)), ASK(peri_cracks_create(b, &desc, &cracks)), ASK(peri_cracks_paths(cracks));
        ASK(peri_cracks_vertices(cracks)), ASK(peri_cracks_tips(cracks)), ASK(peri_get_cracks(cracks, NULL, NULL, NULL, NULL));
        ASK(peri_export_cracks_to(cracks, take_bytes, NULL));
        return;
    }
    ASK(peri_cracks_create(b, NULL, &cracks)), ASK(peri_cracks_create(b, &desc, NULL));
    desc.shortest = -1, ASK(peri_cracks_create(b, &desc, &cracks));
    desc.shortest = 0, desc.current = 2, ASK(peri_cracks_create(b, &desc, &cracks));
    desc.current = 1, desc.initial = -1, ASK(peri_cracks_create(b, &desc, &cracks));
    desc.initial = 0, desc.cookie++, ASK(peri_cracks_create(b, &desc, &cracks));
    desc.cookie--, MUST(b, peri_cracks_create(b, &desc, &cracks));
    ASK(peri_export_cracks_to(cracks, take_bytes, b)), ASK(peri_export_cracks_to(cracks, NULL, NULL));
    peri_cracks_destroy(cracks);
}

/* Fragments, outlines and what goes by present positions. */
static void ask_of_pieces(peri_body *b, const double *place) {
    static peri_fragment pieces[256];
    int64_t count[2];
    ASK(peri_find_fragments(b, ints, 512)), ASK(peri_get_fragments(b, pieces, 256)), ASK(peri_size_of_outline(b, -1, count, count + 1));
    ASK(peri_get_outline(b, -1, numbers, 4, ints, NULL, NULL, 4)), ASK(peri_find_point(b, place)), ASK(peri_find_point_in_place(b, place));
    ASK(peri_select_box_in_place(b, "b", place, far3)), ASK(peri_select_ball_in_place(b, "b", place, 9));
    ASK(peri_size_of_outline(b, 7, count, count + 1)), ASK(peri_get_outline(b, 7, numbers, 4, ints, NULL, NULL, 4));
    ASK(peri_find_fragments(b, ints, 1)), ASK(peri_get_fragments(b, pieces, 0)), ASK(peri_find_fragments(b, NULL, 1));
    ASK(peri_select_box_in_place(b, NULL, up3, zero3)), ASK(peri_select_ball_in_place(b, NULL, far3, 1e-9));
}

/* Fields of material, and strengths of bonds. */
static int32_t fail_pairs(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    return (void)user, (void)i, (void)j, (void)xi, (void)xj, -7;
}
static void with_fields(void) {
    specimen s = plate_of(PERI_LAW_LPS);
    static double halves[120];
    const double half = 0.5, none = 0;
    const int32_t beyond[2] = {0, 500}, apart[2] = {0, 119};
    peri_body *d = specimen_start(&s), *b = specimen_make(&s);
    for (int k = 0; k < 120; ++k) halves[k] = 0.5;
    ASK(peri_set_strength_pairs(NULL, 1, two, &half)), ASK(peri_set_strength_if(NULL, 0.5, cut_none, NULL));
    ASK(peri_set_strength_pairs(d, 1, two, &half)), ASK(peri_set_strength_if(d, 0.5, cut_none, NULL));
    ASK(peri_set_strength_pairs(b, -1, two, &half)), ASK(peri_set_strength_pairs(b, 1, NULL, &half));
    ASK(peri_set_strength_pairs(b, 1, two, NULL)), ASK(peri_set_strength_pairs(b, 1, two, &none));
    ASK(peri_set_strength_pairs(b, 1, beyond, &half)), ASK(peri_set_strength_pairs(b, 1, apart, &half));
    ASK(peri_set_strength_if(b, 0.5, NULL, NULL)), ASK(peri_set_strength_if(b, -1, cut_none, NULL));
    ASK(peri_set_strength_if(b, 0.5, fail_pairs, NULL));
    fail_in = 0, ASK(peri_set_strength_pairs(b, 1, two, &half)), fail_in = 0, ASK(peri_set_strength_if(b, 0.5, cut_none, NULL));
    fail_in = 0, ASK(peri_set_field(b, PERI_FIELD_STRENGTH, halves, 120)), fail_in = -1;
    ASK(peri_set_field(b, PERI_FIELD_STRENGTH, halves, 7)), ASK(peri_set_field(b, PERI_FIELD_STIFFNESS, NULL, 120));
    peri_body_destroy(d), peri_body_destroy(b);
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    s.material.fracture_energy = 1;
    b = specimen_make(&s), ASK(peri_set_field(b, PERI_FIELD_EIGENSTRAIN, halves, 120)), peri_body_destroy(b);
    s = plate_of(PERI_LAW_BOND_BASED);
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL_CENTROID;
    b = specimen_make(&s), ASK(peri_set_field(b, PERI_FIELD_STRENGTH, halves, 120));
    ASK(peri_set_strength_pairs(b, 1, two, &half)), ASK(peri_set_strength_if(b, 0.5, cut_none, NULL)), peri_body_destroy(b);
}

static const peri_advance_desc *steps_in_time(double step) {
    static peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.time_step = step;
    r.steps = 2;
    return &r;
}
static int32_t stop_iteration(void *user, int64_t iteration, double residual) { return (void)iteration, (void)residual, *(int *)user; }
static void with_implicit_steps(void) {
    const specimen s = plate_of(PERI_LAW_BOND_BASED);
    peri_body *d = specimen_start(&s), *b = specimen_make(&s);
    peri_advance_desc wrong = *steps_in_time(1);
    peri_solve_desc st;
    int said = 1;
    ASK(peri_advance_implicit(NULL, &wrong, NULL, 1, NULL)), ASK(peri_advance_implicit(d, &wrong, NULL, 1, NULL));
    ASK(peri_advance_implicit(b, NULL, NULL, 1, NULL)), ASK(peri_advance_implicit(b, &wrong, NULL, 2, NULL));
    wrong.force_step = 3, ASK(peri_advance_implicit(b, &wrong, NULL, 1, NULL));
    wrong.cookie = 0, ASK(peri_advance_implicit(b, &wrong, NULL, 1, NULL));
    fail_in = 0, ASK(peri_advance_implicit(b, steps_in_time(1), NULL, 1, NULL)), fail_in = -1;
    MUST(b, peri_add_velocity(b, PERI_ALL, one3)), MUST(b, peri_apply_body_force(b, PERI_ALL, one3, NULL, NULL));
    peri_solve_desc_init(&st), st.method = PERI_METHOD_BICGSTAB, ASK(peri_advance_implicit(b, steps_in_time(1), &st, 1, NULL));
    peri_solve_desc_init(&st), st.on_iteration = stop_iteration, st.user = &said;
    ASK(peri_advance_implicit(b, steps_in_time(1), &st, 1, NULL));
    said = -1, ASK(peri_advance_implicit(b, steps_in_time(1), &st, 1, NULL));
    st.on_iteration = NULL, st.newton = st.iterations = 1, st.tolerance = 1e-15;
    ASK(peri_advance_implicit(b, steps_in_time(1), &st, 1, NULL));
    peri_body_destroy(d), peri_body_destroy(b);
}

/* Forces at a displacement: too early, stopped by a load, and a rule that has no tangent. */
static int32_t stop_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    return (void)user, (void)time, (void)count, (void)points, (void)value, 1;
}
static void with_evaluations(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED);
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL_CENTROID;
    peri_body *d = specimen_start(&s), *b = specimen_make(&s);
    memset(numbers, 0, sizeof numbers);
    peri_evaluate_desc_init(&forces), ASK(peri_evaluate(d, &forces, NULL));
    ASK(peri_multiply_stiffness_at(d, numbers, numbers, numbers, 240)), ASK(peri_multiply_stiffness_at(b, numbers, numbers, numbers, 240));
    ASK(peri_save_state_to(d, take_bytes, NULL)), ASK(peri_save_state(d, "build/x")), ASK(peri_load_state(d, "build/x"));
    ASK(peri_load_state_from(d, no_bytes, NULL)), ASK(peri_load_state_from(b, no_bytes, NULL)), ASK(peri_load_state(b, "build/none"));
    ASK(peri_save_state_to(b, take_bytes, b)), ASK(peri_save_state(b, "build/none/x"));
    MUST(b, peri_apply_body_force(b, PERI_ALL, one3, stop_load, NULL)), forces.fracture = 1, ASK(peri_evaluate(b, &forces, NULL));
    peri_body_destroy(d), peri_body_destroy(b);
}

/* A body that is a part: what it has not; before it is one, wrong descriptors; a part whose other runs otherwise. */
static int32_t run_otherwise(void *user, int32_t reduction, int64_t count, double *values) {
    return (void)user, (void)reduction, values[1] += count > 1, 0;
}
static void refuse_parts(peri_body *b) {
    peri_matrix *matrix = NULL;
    peri_cracks *cracks = NULL;
    peri_cracks_desc cracked;
    peri_obstacle_desc ball;
    peri_solve_desc equilibrium;
    peri_solve_report report;
    peri_fragment piece;
    peri_advance_desc run;
    int64_t count[2];
    const double half = 0.5, gradient[4] = {0, 0, 0, 1e9};
    peri_cracks_desc_init(&cracked), peri_solve_desc_init(&equilibrium), peri_evaluate_desc_init(&forces);
    ASK(peri_set_strength_pairs(b, 1, two, &half)), ASK(peri_set_strength_if(b, 0.5, cut_none, NULL));
    ASK(peri_find_fragments(b, ints, 512)), ASK(peri_get_fragments(b, &piece, 1));
    ASK(peri_size_of_outline(b, -1, count, count + 1)), ASK(peri_get_outline(b, -1, numbers, 4, ints, NULL, NULL, 4));
    ASK(peri_apply_traction(b, PERI_ALL, 1, one3, one3, NULL, NULL)), ASK(peri_apply_pressure(b, PERI_ALL, 1, NULL, NULL));
    ASK(peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1, NULL, NULL)), ASK(peri_set_contact(b, PERI_ALL, PERI_ALL, NULL));
    ASK(peri_evaluate(b, &forces, NULL)), ASK(peri_solve(b, &equilibrium, &report)), ASK(peri_matrix_create(b, &matrix));
    ASK(peri_multiply_stiffness(b, numbers, numbers, 240)), ASK(peri_multiply_stiffness_at(b, numbers, numbers, numbers, 240));
    ASK(peri_set_field(b, PERI_FIELD_DENSITY, numbers, 120)), ASK(peri_cracks_create(b, &cracked, &cracks));
    ASK(peri_save_state_to(b, take_bytes, NULL)), ASK(peri_load_state_from(b, no_bytes, NULL)), ASK(peri_get_fragments(b, NULL, 0));
    ASK(peri_save_state(b, "build/x")), ASK(peri_load_state(b, "build/x"));
    ASK(peri_get_field(b, PERI_FIELD_FRAGMENT, numbers, 120)), ASK(peri_view_field(b, PERI_FIELD_FRAGMENT, &view));
    ASK(peri_get_field_at(b, PERI_FIELD_FRAGMENT, 1, two, numbers, 1));
    ASK(peri_interpolate_field(b, PERI_FIELD_FRAGMENT, 0, 1, one3, numbers, 1));
    peri_obstacle_desc_init(&ball, PERI_SHAPE_BALL), ball.radius = ball.mass = 1, ASK(peri_add_obstacle(b, &ball));
    peri_advance_desc_init(&run), run.steps = 1, ASK(peri_advance_implicit(b, &run, NULL, 0.8, NULL));
    ASK(peri_set_mean_gradient(b, NULL)), ASK(peri_set_mean_gradient(b, gradient));
}
/* Cells of the caller, and grids: in turn each thing is wrong, and put right again. */
static void with_cells(void) {
    const specimen s = plate_of(PERI_LAW_BOND_BASED);
    const double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, wide[2] = {1, 1e300};
    const int64_t offsets[2] = {0, 2};
    int32_t order[4] = {0, 1, 2, 3}, count[2] = {3, 2}, wrong[4] = {0, PERI_ALL, 0, 0};
    peri_body *b = specimen_make(&s), *d = specimen_start(&s), *none = NULL;
    peri_cells_desc c;
    peri_cells_desc_init(NULL), peri_cells_desc_init(&c);
    const int32_t material = peri_id(d, PERI_KIND_MATERIAL, 1);
    c.vertex_count = c.cell_corners = 4, c.vertices = square[0], c.cell_count = 1, c.corners = order;
    MUST(NULL, peri_body_create(&s.desc, &none, NULL)), ASK(peri_add_cells(none, &c)), peri_body_destroy(none);
    ASK(peri_add_cells(NULL, &c)), ASK(peri_add_cells(b, &c)), ASK(peri_add_cells(d, NULL));
    c.cookie++, ASK(peri_add_cells(d, &c)), c.cookie--;
    fail_in = 0, ASK(peri_add_cells(d, &c)), fail_in = -1;
    c.cell_count = 0, ASK(peri_add_cells(d, &c)), c.cell_count = INT64_C(3000000000), ASK(peri_add_cells(d, &c)), c.cell_count = 1;
    order[1] = 4, ASK(peri_add_cells(d, &c)), order[1] = 2, order[2] = 1, ASK(peri_add_cells(d, &c));
    order[1] = 1, order[2] = 2, c.offsets = offsets, ASK(peri_add_cells(d, &c)), c.offsets = NULL, c.materials = wrong;
    wrong[2] = peri_id(b, PERI_KIND_MATERIAL, 1), wrong[3] = material + 9;
    for (; c.materials < wrong + 4; ++c.materials) ASK(peri_add_cells(d, &c)), ASK(peri_add_grid(d, *c.materials, zero3, far3, count));
    c.materials = NULL;
    ASK(peri_add_grid(NULL, material, zero3, far3, count)), ASK(peri_add_grid(b, material, zero3, far3, count));
    ASK(peri_add_grid(d, material, zero3, far3, NULL)), ASK(peri_add_grid(d, material, zero3, wide, two));
    fail_in = 0, ASK(peri_add_grid(d, material, zero3, far3, count)), fail_in = -1;
    count[0] = count[1] = 1 << 20, ASK(peri_add_grid(d, material, zero3, far3, count));
    CHECK(peri_point_count(d) == 0 && peri_add_cells(d, &c) == 1);
    peri_body_destroy(b), peri_body_destroy(d);
}
static void with_parts(void) {
    specimen s = plate_of(PERI_LAW_LPS);
    peri_part_desc p;
    peri_advance_desc r;
    const int32_t none[2] = {0, 0}, ghosts[2] = {3, 2};
    const double wide[2] = {1, 1e300};
    peri_body *d = specimen_start(&s), *b = specimen_make(&s);
    peri_part_desc_init(&p), p.length = p.mean_volume = 1;
    ASK(peri_set_part(NULL, &p)), ASK(peri_set_part(b, &p)), ASK(peri_set_part(d, &p)), ASK(peri_ghost_depth(NULL));
    ASK(peri_set_mean_gradient(NULL, one3)), ASK(peri_set_mean_gradient(d, one3)), ASK(peri_set_mean_gradient(b, one3));
    const int32_t material = peri_id(d, PERI_KIND_MATERIAL, 1), there[2] = {1, 1};
    ASK(peri_add_box_part(NULL, material, zero3, far3, 1, none, there)), ASK(peri_add_box_part(b, material, zero3, far3, 1, none, there));
    ASK(peri_add_box_part(d, 0, zero3, far3, 1, none, there)), ASK(peri_add_box_part(d, material, zero3, far3, 1, NULL, there));
    ASK(peri_add_box_part(d, peri_id(b, PERI_KIND_MATERIAL, 1), zero3, far3, 1, none, there));
    ASK(peri_add_box_part(d, material + 7, zero3, far3, 1, none, there));
    ASK(peri_add_box_part(d, PERI_ALL, zero3, far3, 1, none, there));
    ASK(peri_add_box_part(d, material, zero3, far3, 1, none, none)), ASK(peri_add_box_part(d, material, zero3, wide, 1, none, there));
    ASK(peri_add_box_part(d, material, zero3, far3, 1e-9, none, there));
    fail_in = 0, ASK(peri_add_box_part(d, material, zero3, far3, 1, none, there)), fail_in = -1;
    peri_body_destroy(b);
    MUST(d, peri_add_box(d, material, s.lo, s.hi, s.spacing));
    p.cookie++, ASK(peri_set_part(d, &p)), p.cookie--, ASK(peri_set_part(d, NULL));
    p.length = 0, ASK(peri_set_part(d, &p)), p.length = 1, p.ghost_count = 2, p.ghosts = ghosts, ASK(peri_set_part(d, &p));
    p.ghost_count = 0, fail_in = 0, ASK(peri_set_part(d, &p)), fail_in = -1;
    p.reduce = run_otherwise, MUST(d, peri_set_part(d, &p));
    MUST(d, peri_set_families(d, 1, ints)), ASK(peri_build(d)), peri_body_destroy(d);
    d = specimen_start(&s);
    MUST(d, peri_add_box(d, peri_id(d, PERI_KIND_MATERIAL, 1), s.lo, s.hi, s.spacing));
    MUST(d, peri_set_part(d, &p)), MUST(d, peri_build(d));
    peri_advance_desc_init(&r), r.steps = 1, ASK(peri_advance(d, &r));
    refuse_parts(d);
    peri_body_destroy(d);
}

#include "calls_worlds.h"

#endif
