/* SPDX-License-Identifier: MIT */
/* restart_scene.h - small bodies that break while supports, loads and a moving obstacle act on them, of any law, precision, criterion and
   storage; and all that can be seen of a state, to the last bit. */
#ifndef RESTART_SCENE_H
#define RESTART_SCENE_H

#include "criterion.h"
#include "scene.h"
#include "specimen.h"

typedef struct scene {
    int32_t space, law, criterion, precision, geometry, timing, correction, threads, instructions, scattered, bare;
} scene;

static inline scene scene_of(int32_t law, int32_t criterion, int32_t precision, int32_t scattered) {
    const scene s = { PERI_SPACE_PLANE_STRESS, law,         criterion, precision, PERI_GEOMETRY_NONLINEAR, PERI_BREAK_WITHIN_STEP,
                      PERI_CORRECTION_NONE,    1, PERI_INSTRUCTIONS_BEST, scattered, 0 };
    return s;
}

static inline int32_t shake(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const int dim = *(const int *)user;
    (void)points;
    for (int64_t k = 0; k < count * dim; ++k) value[k] = k % dim == 0 ? 0.02 * (1 - cos(0.7 * time)) : 0.003 * sin(time + (double)k);
    return 0;
}

static inline int32_t swing(void *user, double time, double *place, double *turn) {
    (void)user, (void)turn;
    place[1] += 0.05 * time;
    return 0;
}

/* A bar of 10 x 6 (x 3) cells of 0.37, notched: a grip at its left end, one that pulls at its right, shaken by a body force, met by a
   ball from below. bare: free, of its own motion alone. */
static inline peri_body *scene_make(const scene *at) {
    static int dims[2] = { 2, 3 };
    const int solid = at->space == PERI_SPACE_SOLID;
    specimen s = specimen_of(at->space, at->law, 0.27, 0.37, 2.1, 10, solid ? 4 : 6, 3);
    double lo[3] = { 0, 0, 0 }, hi[3], from[2] = { 5 * 0.37, -1 }, to[2] = { 5 * 0.37, 2.2 * 0.37 }, centre[3] = { 6 * 0.37, -0.7, 0.5 };
    s.desc.precision = at->precision;
    s.desc.geometry = at->geometry;
    s.desc.break_timing = at->timing;
    s.desc.correction = at->correction;
    s.desc.threads = at->threads;
    s.desc.instructions = at->instructions;
    s.desc.number = 5;
    s.desc.thickness = 0.3;
    s.material.young = 3.1;
    s.material.density = 0.7;
    s.material.criterion = at->criterion;
    if (at->criterion == PERI_CRITERION_STRETCH) s.material.critical_stretch = 0.02;
    else if (at->criterion <= PERI_CRITERION_NODE_ENERGY) s.material.fracture_energy = 0.002;
    else give_criterion(&s.material, at->criterion, 0.02, s.desc.horizon, 0.3);
    if (at->scattered) s.scatter = 0.4, s.seed = 11;
    peri_body *b = specimen_make(&s);
    memcpy(hi, s.hi, sizeof hi);
    if (!solid) (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    hi[0] = 0.8;
    const int32_t left = (int32_t)MUST(b, peri_select_box(b, "left", lo, hi));
    lo[0] = 10 * 0.37 - 0.8, hi[0] = 10 * 0.37;
    const int32_t right = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), xy = PERI_AXIS_XY;
    double motion[600];
    uint64_t seed = 3;
    const int64_t dofs = peri_point_count(b) * peri_dimension(b);
    CHECK(dofs <= 600);
    for (int64_t k = 0; k < dofs; ++k) motion[k] = 0.03 * (test_random(&seed) - 0.5);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, motion, dofs));
    if (at->bare) return b;
    (void)MUST(b, peri_prescribe_displacement(b, left, PERI_AXIS_X, NULL, NULL, NULL));
    (void)MUST(b, peri_prescribe_velocity(b, right, xy, NULL, shake, &dims[solid]));
    (void)MUST(b, peri_apply_body_force(b, left, NULL, shake, &dims[solid]));
    (void)MUST(b, ball_obstacle(b, centre, 0.8, 0, swing, NULL));
    return b;
}

static inline int32_t scene_run(peri_body *b, int64_t steps) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = steps;
    a.damping = 0.05;
    return (int32_t)MUST(b, peri_advance(b, &a));
}

/* a = b to so many times the largest. */
static inline int alike(const double *a, const double *b, int64_t count, double relative) {
    const double most = largest(b, count);
    for (int64_t k = 0; k < count; ++k)
        if (!(fabs(a[k] - b[k]) <= relative * most)) return 0;
    return 1;
}

/* A displacement of some size. */
static inline void shape_of(double *u, int64_t dofs, double size) {
    uint64_t seed = 9;
    for (int64_t k = 0; k < dofs; ++k) u[k] = size * (test_random(&seed) - 0.5);
}

/* ---- what can be seen --------------------------------------------------------------------------------------------------------------- */

static inline int same_view(peri_body *a, peri_body *b, int32_t field) {
    peri_view v, w;
    (void)MUST(a, peri_view_field(a, field, &v));
    (void)MUST(b, peri_view_field(b, field, &w));
    if (v.count != w.count || v.type != w.type) return 0;
    const size_t size = v.type == PERI_TYPE_F32 ? sizeof(float) : sizeof(double);
    for (int32_t d = 0; d < v.components; ++d)
        for (int64_t i = 0; i < v.count; ++i)
            if (memcmp((const char *)v.data + (size_t)(i * v.point_stride + d * v.component_stride) * size,
                       (const char *)w.data + (size_t)(i * w.point_stride + d * w.component_stride) * size, size) != 0) return 0;
    return 1;
}

/* Do both bodies show the same bits? */
static inline int same_state(peri_body *a, peri_body *b) {
    double force[2][3] = { { 0 } }, step[2] = { peri_stable_step(a), peri_stable_step(b) }, time[2] = { peri_time(a), peri_time(b) };
    peri_energy e[2];
    int same = peri_broken_count(a) == peri_broken_count(b) && peri_cut_count(a) == peri_cut_count(b)
            && peri_step_count(a) == peri_step_count(b) && memcmp(&step[0], &step[1], sizeof step[0]) == 0
            && memcmp(&time[0], &time[1], sizeof time[0]) == 0 && peri_load_factor(a) == peri_load_factor(b);
    for (int32_t field = PERI_FIELD_POSITION; field < peri__end_field; ++field) same = same && same_view(a, b, field);
    for (int64_t k = 1; peri_id(a, PERI_KIND_LOAD, k) > 0; ++k) {
        if (peri_get_reaction(a, peri_id(a, PERI_KIND_LOAD, k), force[0]) < 0) continue; /* removed */
        (void)MUST(b, peri_get_reaction(b, peri_id(b, PERI_KIND_LOAD, k), force[1]));
        same = same && memcmp(force[0], force[1], sizeof force[0]) == 0;
    }
    for (int64_t k = 1; peri_id(a, PERI_KIND_OBSTACLE, k) > 0; ++k) {
        (void)MUST(a, peri_get_obstacle_force(a, peri_id(a, PERI_KIND_OBSTACLE, k), force[0], NULL));
        (void)MUST(b, peri_get_obstacle_force(b, peri_id(b, PERI_KIND_OBSTACLE, k), force[1], NULL));
        same = same && memcmp(force[0], force[1], sizeof force[0]) == 0;
    }
    (void)MUST(a, peri_get_energy(a, &e[0]));
    (void)MUST(b, peri_get_energy(b, &e[1]));
    return same && memcmp(&e[0], &e[1], sizeof e[0]) == 0;
}

/* ---- bytes in memory ------------------------------------------------------------------------------------------ */

typedef struct buffer {
    unsigned char *data;
    int64_t        count, room, at;
} buffer;

static inline int32_t write_bytes(void *user, const void *from, int64_t count) {
    buffer *to = (buffer *)user;
    if (to->count + count > to->room) {
        to->room = 2 * (to->count + count);
        to->data = (unsigned char *)realloc(to->data, (size_t)to->room);
    }
    memcpy(to->data + to->count, from, (size_t)count);
    to->count += count;
    return 0;
}

static inline int32_t read_bytes(void *user, void *to, int64_t count) {
    buffer *from = (buffer *)user;
    if (count > from->count - from->at) return 1;
    memcpy(to, from->data + from->at, (size_t)count);
    from->at += count;
    return 0;
}

static inline void save(peri_body *b, buffer *to) {
    to->count = to->at = 0;
    (void)MUST(b, peri_save_state_to(b, write_bytes, to));
}

static inline int32_t load(peri_body *b, buffer *from) {
    from->at = 0;
    return peri_load_state_from(b, read_bytes, from);
}

#endif
