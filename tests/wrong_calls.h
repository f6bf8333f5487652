/* SPDX-License-Identifier: MIT */
/* wrong_calls.h - calls on a built body that must be refused, for the story of test_errors.c: what it goes through beside is the same. */
#ifndef WRONG_CALLS_H
#define WRONG_CALLS_H

#include "refusal.h"

static inline void wrong_sets_and_cracks(peri_body *b) {
    const double a[2] = {0.4, 0}, z[2] = {0.4, 0.32}, nowhere[2] = {7, 7}, nan2[2] = {0, NAN}, third[3] = {0, 0, 1}, wide[2] = {0.8, 0.6};
    const int32_t points[3] = {4, 52, 1}, pairs[4] = {0, 1, 0, 47}, beyond[4] = {0, 1, 0, -1};
    int32_t buffer[64];
    REFUSE(b, PERI_ERROR_EMPTY, peri_select_box(b, NULL, nowhere, nowhere));
    REFUSE(b, PERI_ERROR_EMPTY, peri_select_ball(b, NULL, nowhere, 1));
    REFUSE(b, PERI_ERROR_EMPTY, peri_select_if(b, NULL, take_none, NULL));
    REFUSE(b, PERI_ERROR_NAME, peri_select_box(b, "left", a, wide)); /* the name is taken */
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_select_if(b, NULL, NULL, NULL));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_select_box(b, NULL, NULL, z));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_select_points(b, NULL, 3, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_select_ball(b, NULL, a, NAN));
    REFUSE(b, PERI_ERROR_INDEX, peri_select_points(b, NULL, 3, points));
    CHECK(seen.index == 1 || seen.index == 52);
    REFUSE(b, PERI_ERROR_NAME, peri_find_set(b, "right"));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_find_set(b, NULL));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_size_of_set(b, 99));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_size_of_set(b, -16));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_get_set(b, 99, buffer, 64));
    REFUSE(b, PERI_ERROR_CAPACITY, peri_get_set(b, PERI_ALL, buffer, 51));
    CHECK_NEAR(seen.value, 52, 0, 0);
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_set(b, PERI_ALL, NULL, 64));
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_segment(b, PERI_CUT_INITIAL, a, a));
    REFUSE(b, PERI_ERROR_RANGE, peri_cut_segment(b, PERI_CUT_INITIAL, a, nan2));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_cut_segment(b, PERI_CUT_INITIAL, NULL, z));
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_disc(b, PERI_CUT_INITIAL, third, third, 1)); /* 3D only */
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_triangle(b, PERI_CUT_INITIAL, third, third, third));
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_rectangle(b, PERI_CUT_INITIAL, third, third, third));
    CHECK(peri_cut_polyline(b, PERI_CUT_INITIAL, 1, a) < 0 && peri_cut_polyline(b, PERI_CUT_INITIAL, -1, a) < 0);
    CHECK(peri_cut_polyline(b, PERI_CUT_INITIAL, 2, NULL) < 0);
    REFUSE(b, PERI_ERROR_PAIR, peri_cut_pairs(b, PERI_CUT_INITIAL, 2, pairs));
    CHECK(seen.index == 1);
    REFUSE(b, PERI_ERROR_INDEX, peri_cut_pairs(b, PERI_CUT_INITIAL, 2, beyond));
    CHECK(seen.index == 1 || seen.index == -1);
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_cut_if(b, PERI_CUT_INITIAL, NULL, NULL));
    REFUSE(b, PERI_ERROR_CHOICE, peri_cut_segment(b, 0, a, z));
    FIELD_IS("standing");
    CHECK(peri_cut_count(b) == 0 && peri_bond_is_intact(b, 0, 1) == 1); /* the first pair of the list was not cut */
    REFUSE(b, PERI_ERROR_PAIR, peri_bond_is_intact(b, 0, 47));
    REFUSE(b, PERI_ERROR_INDEX, peri_bond_is_intact(b, 0, 52));
    REFUSE(b, PERI_ERROR_INDEX, peri_bond_is_intact(b, -1, 3));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_set_no_fail(b, 5, 1));
    REFUSE(b, PERI_ERROR_CHOICE, peri_set_no_fail(b, PERI_ALL, 2));
    FIELD_IS("on");
}

static inline void wrong_loads(peri_body *b, int32_t set) {
    const double v[2] = {1, 2}, nan2[2] = {1, NAN}, zero[2] = {0, 0}, left[2] = {-1, 0};
    double f[3];
    REFUSE(b, PERI_ERROR_CHOICE, peri_prescribe_velocity(b, set, 0, v, NULL, NULL));
    REFUSE(b, PERI_ERROR_CHOICE, peri_prescribe_velocity(b, set, 3, v, NULL, NULL));
    CHECK(seen.value == 3);
    FIELD_IS("axes");
    REFUSE(b, PERI_ERROR_CHOICE, peri_prescribe_displacement(b, set, PERI_AXIS_Z, v, NULL, NULL));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_prescribe_displacement(b, -16, PERI_AXIS_X, v, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_prescribe_velocity(b, set, PERI_AXIS_X | PERI_AXIS_Y, nan2, NULL, NULL));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_apply_body_force(b, 99, v, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_apply_body_force(b, set, nan2, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_apply_layer_traction(b, set, 0, v, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_apply_layer_traction(b, set, -1, v, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_apply_layer_traction(b, set, 1, nan2, NULL, NULL));
    REFUSE(b, PERI_ERROR_AREA, peri_apply_traction(b, set, 100, left, v, NULL, NULL));
    REFUSE(b, PERI_ERROR_ID_GONE, peri_id(b, PERI_KIND_LOAD, 6));
    REFUSE(b, PERI_ERROR_CHOICE, peri_id(b, 3, 1));
    REFUSE(b, PERI_ERROR_ID_KIND, peri_remove_load(b, set));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 6)));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_remove_load(b, -1));
    REFUSE(b, PERI_ERROR_ID_KIND, peri_get_reaction(b, set, f));
    REFUSE(b, PERI_ERROR_ID_KIND, peri_get_obstacle_force(b, set, f, NULL));
    REFUSE(b, PERI_ERROR_RANGE, plane_obstacle(b, v, zero, 0, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, plane_obstacle(b, v, v, -1, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, ball_obstacle(b, v, 0, 1, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, ball_obstacle(b, nan2, 1, 1, NULL, NULL));
    REFUSE(b, PERI_ERROR_ARGUMENT, plane_obstacle(b, NULL, v, 0, NULL, NULL));
    REFUSE(b, PERI_ERROR_ARGUMENT, ball_obstacle(b, NULL, 1, 0, NULL, NULL));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_add_velocity(b, set, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_add_velocity(b, set, nan2));
    REFUSE(b, PERI_ERROR_ID_NONE, peri_add_displacement(b, 77, v));
}

#define BAD_RUN(code, name, change)                                                                                    \
    do {                                                                                                               \
        peri_advance_desc_init(&r);                                                                                             \
        r.steps = 3;                                                                                                   \
        change;                                                                                                        \
        REFUSE(b, (code), peri_advance(b, &r));                                                                        \
        FIELD_IS(name);                                                                                                \
    } while (0)

static inline void wrong_runs_and_reads(peri_body *b, int32_t mat) {
    double buffer[128], *u;
    int32_t rows[256];
    int64_t n = peri_size_of_field(b, PERI_FIELD_VELOCITY);
    peri_advance_desc r;
    peri_view view;
    BAD_RUN(PERI_ERROR_DESCRIPTOR, "desc", memset(&r, 0, sizeof r));
    BAD_RUN(PERI_ERROR_CHOICE, "integrator", r.integrator = PERI_INTEGRATOR_CENTRAL_DIFFERENCE + 1);
    BAD_RUN(PERI_ERROR_CHOICE, "force_step", r.force_step = 2);
    BAD_RUN(PERI_ERROR_ARGUMENT, "duration", r.duration = 1); /* one of the two */
    BAD_RUN(PERI_ERROR_RANGE, "duration", r.steps = 0; r.duration = -1);
    BAD_RUN(PERI_ERROR_RANGE, "duration", r.steps = 0; r.duration = NAN);
    BAD_RUN(PERI_ERROR_RANGE, "time_step", r.time_step = -1e-3);
    BAD_RUN(PERI_ERROR_RANGE, "time_step", r.time_step = HUGE_VAL);
    BAD_RUN(PERI_ERROR_RANGE, "safety", r.safety = 0);
    BAD_RUN(PERI_ERROR_RANGE, "safety", r.safety = 1.01);
    BAD_RUN(PERI_ERROR_RANGE, "damping", r.damping = -1);
    BAD_RUN(PERI_ERROR_RANGE, "load_factor", r.load_factor = HUGE_VAL);
    BAD_RUN(PERI_ERROR_STEP, "time_step", r.time_step = 1.01 * peri_stable_step(b));
    CHECK_NEAR(seen.value, peri_stable_step(b), 1e-12, 0);
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_advance(b, NULL));
    r.steps = -1;
    CHECK(peri_advance(b, &r) < 0);
    REFUSE(b, PERI_ERROR_CHOICE, peri_size_of_field(b, 0));
    REFUSE(b, PERI_ERROR_CHOICE, peri_get_field(b, 99, buffer, 128));
    REFUSE(b, PERI_ERROR_CAPACITY, peri_get_field(b, PERI_FIELD_VELOCITY, buffer, n - 1));
    CHECK_NEAR(seen.value, (double)n, 0, 0);
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_field(b, PERI_FIELD_VELOCITY, NULL, n));
    REFUSE(b, PERI_ERROR_CHOICE, peri_view_field(b, peri__end_field, &view));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_view_field(b, PERI_FIELD_DAMAGE, NULL));
    u = get(b, PERI_FIELD_VELOCITY);
    REFUSE(b, PERI_ERROR_PART, peri_set_mean_gradient(b, u)); /* of a body that is no part */
    REFUSE(b, PERI_ERROR_FIELD, peri_set_field(b, PERI_FIELD_POSITION, u, n));
    REFUSE(b, PERI_ERROR_FIELD, peri_set_field(b, PERI_FIELD_DAMAGE, u, n));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_set_field(b, PERI_FIELD_VELOCITY, NULL, n));
    CHECK(peri_set_field(b, PERI_FIELD_VELOCITY, u, n - 1) < 0);
    u[7] = NAN;
    REFUSE(b, PERI_ERROR_RANGE, peri_set_field(b, PERI_FIELD_VELOCITY, u, n));
    CHECK(seen.index == 3); /* the point */
    free(u);
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_energy(b, NULL));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_export_vtu_to(b, NULL, NULL));
    REFUSE(b, PERI_ERROR_WRITE, peri_export_vtu_to(b, write_nothing, NULL));
    REFUSE(b, PERI_ERROR_WRITE, peri_save_state_to(b, write_nothing, NULL));
    REFUSE(b, PERI_ERROR_STATE, peri_load_state(b, "/nonexistent-dir/x.state"));
    REFUSE(b, PERI_ERROR_WRITE, peri_export_history_to(b, 1, write_nothing, NULL));
    REFUSE(b, PERI_ERROR_WRITE, peri_export_vtu(b, "/nonexistent-dir/x.vtu"));
    REFUSE(b, PERI_ERROR_WRITE, peri_export_history(b, "/nonexistent-dir/x.csv", 0));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_export_vtu(b, NULL));
    CHECK(peri_get_families(b, 50, 3, rows, 256) < 0 && peri_get_families(b, -1, 1, rows, 256) < 0);
    REFUSE(b, PERI_ERROR_CAPACITY, peri_get_families(b, 0, 3, rows, 3 * peri_family_width(b) - 1));
    CHECK_NEAR(seen.value, 3 * peri_family_width(b), 0, 0);
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_families(b, 0, 1, NULL, 256));
    REFUSE(b, PERI_ERROR_ID_GONE, peri_get_bond_constants(b, mat, mat + 3, NULL, NULL));
}

#endif
