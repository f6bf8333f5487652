/* SPDX-License-Identifier: MIT */
/* tension.h - the plate of [T] 4.2: 8 mm x 2 mm, plane stress, E 71 GPa, 2780 kg/m^3, LPS, pulled by a force on the last column of points
   of each end. Points lie at the multiples of the spacing, so that one is in the middle. */
#ifndef TENSION_H
#define TENSION_H

#include "gallery.h"

static const double mm = 1e-3, young = 71e9, stress = 100e6;

typedef struct plate {
    double     nu, horizon;
    int        m; /* horizon over spacing */
    int32_t    influence, quadrature;
    peri_body *body;
    int        columns, rows, middle;
} plate;

static inline void pull_end(const plate *p, double side) {
    const double h = p->horizon / p->m, end = 0.5 * p->columns * h, high = 0.5 * p->rows * h, value[2] = {side * stress, 0};
    const double lo[2] = {side < 0 ? -end : end - h, -high}, hi[2] = {lo[0] + h, high};
    const int32_t set = must(p->body, peri_select_box(p->body, NULL, lo, hi));
    (void)must(p->body, peri_apply_layer_traction(p->body, set, 2 * high, value, NULL, NULL));
}

static inline void hold_point(const plate *p, int32_t point, int32_t axes) {
    const int32_t set = must(p->body, peri_select_points(p->body, NULL, 1, &point));
    (void)must(p->body, peri_prescribe_displacement(p->body, set, axes, NULL, NULL, NULL));
}

/* Builds and solves; free the body. */
static inline void solve_plate(plate *p) {
    const double h = p->horizon / p->m;
    p->columns = 2 * (int)(4 * mm / h + 0.5) + 1, p->rows = 2 * (int)(1 * mm / h + 0.5) + 1;
    p->middle = p->rows / 2 * p->columns + p->columns / 2;
    const double hi[2] = {0.5 * p->columns * h, 0.5 * p->rows * h}, lo[2] = {-hi[0], -hi[1]};
    peri_body_desc desc;
    peri_material_desc metal;
    peri_solve_desc statics;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.geometry = PERI_GEOMETRY_LINEAR, desc.horizon = p->horizon;
    desc.influence = p->influence, desc.quadrature = p->quadrature;
    p->body = must_create(&desc);
    peri_material_desc_init(&metal, PERI_LAW_LPS);
    metal.young = young, metal.poisson = p->nu, metal.density = 2780;
    const int32_t material = must(p->body, peri_add_material(p->body, &metal));
    (void)must(p->body, peri_add_box(p->body, material, lo, hi, h)), must(p->body, peri_build(p->body));
    pull_end(p, 1), pull_end(p, -1);
    hold_point(p, p->middle, PERI_AXIS_XY), hold_point(p, p->middle + p->columns / 2, PERI_AXIS_Y);
    peri_solve_desc_init(&statics);
    (void)must(p->body, peri_solve(p->body, &statics, NULL));
}

#endif
