/* SPDX-License-Identifier: MIT */
/* contact_scene.h - two bars of one material, a horizon and a bit apart, of which the first may fly at the second. */
#ifndef CONTACT_SCENE_H
#define CONTACT_SCENE_H

#include "peri_test.h"

typedef struct bars {
    peri_body_desc     desc;
    peri_material_desc material;
    peri_contact_desc  contact;
    int                across[3]; /* cells of one bar                                                                      */
    double             spacing, reach, offset; /* horizon over spacing; of the second bar across, in spacings            */
    double             speed;
    int                held;      /* 1: nothing moves across                                                               */
} bars;

static inline bars bars_of(int dim, double reach, int along, int across) {
    bars s;
    memset(&s, 0, sizeof s);
    peri_body_desc_init(&s.desc);
    s.desc.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN;
    s.desc.threads = 1;
    s.spacing = 1e-3;
    s.reach = reach;
    s.desc.horizon = reach * 1.0001 * s.spacing;
    peri_material_desc_init(&s.material, PERI_LAW_BOND_BASED);
    s.material.young = 72e9;
    s.material.density = 2440;
    peri_contact_desc_init(&s.contact);
    s.across[0] = along;
    s.across[1] = s.across[2] = across;
    s.speed = 20;
    return s;
}

/* Where the second bar begins. */
static inline double bars_gap(const bars *s) { return (s->reach + 0.6) * s->spacing; }

static inline peri_body *bars_make(const bars *s) {
    const int dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2;
    double lo[3] = {0, 0, 0}, hi[3], lo2[3], hi2[3], v[3] = {0, 0, 0};
    peri_body *b = NULL;
    int32_t material, first;
    int d;
    for (d = 0; d < 3; ++d) {
        hi[d] = s->across[d] * s->spacing;
        lo2[d] = d == 0 ? hi[0] + bars_gap(s) : s->offset * s->spacing;
        hi2[d] = lo2[d] + hi[d];
    }
    (void)MUST(NULL, peri_body_create(&s->desc, &b, NULL));
    material = (int32_t)MUST(b, peri_add_material(b, &s->material));
    (void)MUST(b, peri_add_box(b, material, lo, hi, s->spacing));
    (void)MUST(b, peri_add_box(b, material, lo2, hi2, s->spacing));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_set_contact(b, material, material, &s->contact));
    first = (int32_t)MUST(b, peri_select_box(b, "first", lo, hi));
    (void)MUST(b, peri_select_box(b, "second", lo2, hi2));
    v[0] = s->speed;
    if (s->speed != 0) (void)MUST(b, peri_add_velocity(b, first, v));
    if (s->held)
        (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, dim == 2 ? PERI_AXIS_Y : PERI_AXIS_Y | PERI_AXIS_Z, NULL, NULL, NULL));
    return b;
}

/* Runs for a time; the status. */
static inline int32_t run_for(peri_body *b, double duration) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.duration = duration;
    return peri_advance(b, &a);
}

static inline int32_t run_steps(peri_body *b, int64_t steps) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = steps;
    return peri_advance(b, &a);
}

/* Mean velocity of the first and of the second half of the points, along x. */
static inline void mean_speeds(peri_body *b, double *first, double *second) {
    const int64_t n = peri_point_count(b) / 2, dim = peri_dimension(b);
    double *v = (double *)malloc((size_t)(2 * n * dim) * sizeof *v);
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, v, 2 * n * dim));
    *first = *second = 0;
    for (int64_t i = 0; i < n; ++i) {
        *first += v[i * dim] / (double)n;
        *second += v[(n + i) * dim] / (double)n;
    }
    free(v);
}

/* Displacements and velocities of both are the same to the last bit. */
static inline int same_motion(peri_body *a, peri_body *b) {
    const int64_t n = peri_point_count(a) * peri_dimension(a);
    const int32_t fields[2] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY};
    double *p = (double *)malloc((size_t)n * sizeof *p), *q = (double *)malloc((size_t)n * sizeof *q);
    int same = peri_point_count(b) * peri_dimension(b) == n;
    for (int k = 0; k < 2; ++k) {
        (void)MUST(a, peri_get_field(a, fields[k], p, n));
        (void)MUST(b, peri_get_field(b, fields[k], q, n));
        same = same && memcmp(p, q, (size_t)n * sizeof *p) == 0;
    }
    free(p);
    free(q);
    return same;
}

#endif
