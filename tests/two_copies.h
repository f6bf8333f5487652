/* SPDX-License-Identifier: MIT */
/* two_copies.h - the scene that static_a.c and static_b.c each run with their own copy of the library: a square, half of it
   thrown to the right, so that it stretches and rings. Returns the momentum in x: half the points at 0.5, mass 0.64*0.5*2. */
#ifndef TWO_COPIES_H
#define TWO_COPIES_H

#include <math.h>
#include <stdio.h>

static double two_copies_run(double *displacement, int32_t count) {
    const double lo[2] = {0, 0}, hi[2] = {0.8, 0.8}, middle[2] = {0.4, 0.8}, v[2] = {0.5, 0};
    double momentum[2] = {0, 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *body = NULL;
    peri_advance_desc run;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 0.3;
    d.thickness = 0.5;
    if (peri_body_create(&d, &body, NULL) < 0) return -1;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 3;
    m.density = 2;
    if (peri_add_box(body, peri_add_material(body, &m), lo, hi, 0.1) != 64 || peri_build(body) < 0) return -2;
    if (peri_add_velocity(body, peri_select_box(body, NULL, lo, middle), v) < 0) return -3;
    peri_advance_desc_init(&run);
    run.steps = 25;
    if (peri_advance(body, &run) != PERI_OK) return -4;
    if (peri_get_field(body, PERI_FIELD_DISPLACEMENT, displacement, count) != PERI_OK) return -5;
    if (peri_get_momentum(body, momentum, NULL) != PERI_OK) return -6;
    peri_body_destroy(body);
    return momentum[0];
}

#endif
