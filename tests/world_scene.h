/* SPDX-License-Identifier: MIT */
/* world_scene.h - bars that are bodies of their own, one behind the other, in a world. */
#ifndef WORLD_SCENE_H
#define WORLD_SCENE_H

#include "contact_scene.h"

/* Fails the test where a call on a world fails. */
static inline int32_t world_must(peri_world *w, int32_t status) {
    peri_error error;
    char text[300];
    if (status >= 0) return status;
    (void)peri_world_get_error(w, &error, NULL);
    (void)peri_format_error(&error, text, sizeof text);
    printf("    %s\n", text);
    CHECK(status >= 0);
    return status;
}

static inline peri_world *world_make(void) {
    peri_world_desc d;
    peri_world *w = NULL;
    peri_world_desc_init(&d);
    CHECK(peri_world_create(&d, &w, NULL) == PERI_OK);
    return w;
}

/* The first bar of s alone, its lower corner at x. */
static inline peri_body *bar_at(const bars *s, double x, double speed) {
    const int dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2;
    const double lo[3] = {x, 0, 0}, hi[3] = {x + s->across[0] * s->spacing, s->across[1] * s->spacing, s->across[2] * s->spacing};
    const double v[3] = {speed, 0, 0};
    peri_body *b = NULL;
    (void)MUST(NULL, peri_body_create(&s->desc, &b, NULL));
    (void)MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &s->material)), lo, hi, s->spacing));
    (void)MUST(b, peri_build(b));
    if (speed != 0) (void)MUST(b, peri_add_velocity(b, PERI_ALL, v));
    if (s->held)
        (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, dim == 2 ? PERI_AXIS_Y : PERI_AXIS_Y | PERI_AXIS_Z, NULL, NULL, NULL));
    return b;
}

static inline int32_t world_for(peri_world *w, double duration) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.duration = duration;
    return peri_world_advance(w, &a);
}

static inline int32_t world_steps(peri_world *w, int64_t steps) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = steps;
    return peri_world_advance(w, &a);
}

static inline double mean_speed(peri_body *b) {
    const int64_t n = peri_point_count(b), dim = peri_dimension(b);
    double *v = (double *)malloc((size_t)(n * dim) * sizeof *v), sum = 0;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, v, n * dim));
    for (int64_t i = 0; i < n; ++i) sum += v[i * dim] / (double)n;
    free(v);
    return sum;
}

#endif
