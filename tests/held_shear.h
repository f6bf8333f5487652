/* SPDX-License-Identifier: MIT */
/* held_shear.h - a block of LPS all of whose points are held, in simple shear u_x = gamma y as supports set it: every family has the same,
   and nothing is left to find but what the law says. */
#ifndef HELD_SHEAR_H
#define HELD_SHEAR_H

#include "scene.h"

/* Linear geometry, lattice, moment correction: uniform strain is then exact within the block. */
static inline specimen shear_specimen(int32_t space) {
    const int solid = space == PERI_SPACE_SOLID;
    specimen s = specimen_of(space, PERI_LAW_LPS, 0.3, H, 2.6, solid ? 7 : 11, solid ? 7 : 11, solid ? 7 : 1);
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.correction = PERI_CORRECTION_MOMENT;
    return s;
}

typedef struct shear { /* value: of gamma, or of its rate, at a time                                                      */
    double (*value)(double time);
    double *x;
    int     dim;
} shear;

static inline int32_t shear_all(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const shear *s = (const shear *)user;
    const double gamma = s->value(time);
    for (int64_t k = 0; k < count; ++k) value[s->dim * k] = gamma * s->x[s->dim * points[k] + 1];
    return 0;
}

/* Holds all points: their displacement, or their velocity. */
static inline void hold_shear(peri_body *b, shear *s, double (*value)(double), int by_velocity) {
    const int32_t axes = peri_dimension(b) == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    s->value = value;
    s->dim = peri_dimension(b);
    s->x = get(b, PERI_FIELD_POSITION);
    if (by_velocity) MUST(b, peri_prescribe_velocity(b, PERI_ALL, axes, NULL, shear_all, s));
    else MUST(b, peri_prescribe_displacement(b, PERI_ALL, axes, NULL, shear_all, s));
}

/* The stress that the bonds of the point in the middle carry in shear. */
static inline double shear_stress(peri_body *b) {
    const int dim = peri_dimension(b), n = dim == 3 ? 6 : 3;
    double *x = get(b, PERI_FIELD_POSITION), *stress = get(b, PERI_FIELD_FORCE_STRESS), middle[3] = {0, 0, 0}, tau;
    for (int64_t k = 0; k < peri_point_count(b) * dim; ++k) middle[k % dim] += x[k] / (double)peri_point_count(b);
    tau = stress[n * peri_find_point(b, middle) + (dim == 3 ? 3 : 2)];
    free(x);
    free(stress);
    return tau;
}

#endif
