/* SPDX-License-Identifier: MIT */
/* moving.h - what motion.c and tiny.c share: small bodies of every law, their fields, and the difference of two of them. */
#ifndef MOVING_H
#define MOVING_H

#include "extremes.h"

#define FIELDS 6

static const int32_t fields[FIELDS] = {PERI_FIELD_ENERGY_DENSITY, PERI_FIELD_FORCE_DENSITY, PERI_FIELD_DILATATION, PERI_FIELD_STRAIN,
                                       PERI_FIELD_STRESS,
                                       PERI_FIELD_FORCE_STRESS};
static const char *const names[FIELDS] = {"energy density", "force density", "dilatation", "strain", "stress", "force stress"};

static inline int dim_of(int32_t space) { return space == PERI_SPACE_SOLID ? 3 : 2; }

/* ---- bodies ------------------------------------------------------------------------------------------------------- */

typedef struct scene {
    int32_t space, precision, law, geometry, correction;
    int     cloud;     /* the cells moved                                                                                */
    double  origin[3]; /* the lower corner                                                                               */
    double  spacing, stretch;
} scene;

static inline scene scene_of(int32_t space, int32_t precision, int32_t law, int32_t geometry) {
    scene s;
    memset(&s, 0, sizeof s);
    s.space = space;
    s.precision = precision;
    s.law = law;
    s.geometry = geometry;
    s.correction = PERI_CORRECTION_NONE;
    s.spacing = 1;
    return s;
}

/* 5 x 4 x 3 cells, or 7 x 5. */
static inline peri_body *small_body(outcome *o, const scene *s) {
    const double h = s->spacing, solid[3] = {5, 4, 3}, plane[3] = {7, 5, 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    double hi[3];
    int k;
    extreme_desc(&d, s->space, s->precision, 2 * h);
    d.geometry = s->geometry;
    d.correction = s->correction;
    extreme_material(&m, s->law, 0.3, s->stretch);
    for (k = 0; k < 3; ++k) hi[k] = s->origin[k] + h * (s->space == PERI_SPACE_SOLID ? solid[k] : plane[k]);
    if (extreme_fails(o, NULL, peri_body_create(&d, &b, NULL)) || extreme_fails(o, b, peri_add_material(b, &m))
        || extreme_fails(o, b, s->cloud ? peri_add_perturbed_box(b, material_id(b, 1), s->origin, hi, h, 0.5, 5)
                                        : peri_add_box(b, material_id(b, 1), s->origin, hi, h)))
        return b;
    (void)extreme_fails(o, b, peri_build(b));
    return b;
}

/* u = G (x - origin) + shift. */
static inline void deform(outcome *o, peri_body *b, const double *gradient, const double *origin, const double *shift) {
    extreme_affine(o, b, gradient, origin);
    if (shift) (void)extreme_fails(o, b, peri_add_displacement(b, PERI_ALL, shift));
}

typedef struct shown { /* the fields of a body                                                                           */
    double *x[FIELDS];
    int64_t n[FIELDS];
} shown;

static inline void show(outcome *o, peri_body *b, shown *s) {
    int k;
    for (k = 0; k < FIELDS; ++k) {
        s->x[k] = extreme_read(o, b, fields[k]);
        s->n[k] = s->x[k] ? peri_size_of_field(b, fields[k]) : 0;
    }
}

static inline void forget(shown *s) {
    int k;
    for (k = 0; k < FIELDS; ++k) free(s->x[k]);
}

/* The largest difference of the fields a and b/scale (energy: scale^2), each as a part of its largest number in a. */
static inline void compare(outcome *o, const extreme *row, const scene *s, const shown *a, const shown *b, double scale, const char *what) {
    int k;
    for (k = 0; k < FIELDS && o->status == PERI_OK; ++k) {
        double largest = 0, difference = 0;
        int64_t i;
        for (i = 0; i < a->n[k]; ++i) {
            const double x = b->x[k][i] / scale / (fields[k] == PERI_FIELD_ENERGY_DENSITY ? scale : 1);
            largest = extreme_worst(largest, fabs(a->x[k][i]));
            difference = extreme_worst(difference, fabs(a->x[k][i] - x));
        }
        if (difference > 0) difference /= largest;
        extreme_note(o, row, s->precision, difference, "%s, %s: law %d, space %d, geometry %d, cloud %d", what, names[k], (int)s->law,
                     (int)s->space, (int)s->geometry, s->cloud);
    }
}

#endif
