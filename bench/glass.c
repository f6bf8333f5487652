/* SPDX-License-Identifier: MIT */
/* glass.c - the crack branching benchmark, from the source that the tests of branching share. */
#include "../tests/glass.h"

peri_body *glass_plate(int32_t precision, double *step, int64_t *steps);

peri_body *glass_plate(int32_t precision, double *step, int64_t *steps) {
    const scene s = glass(300, 1.0);
    options o = { PERI_PRECISION_DOUBLE, 1, NULL, NULL, 0 };
    peri_body_desc desc;
    peri_body *body = NULL;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = s.horizon;
    desc.precision = o.precision = precision;
    if (peri_body_create(&desc, &body, NULL) < 0) return NULL; /* a precision that this library does not have */
    peri_body_destroy(body);
    *step = s.dt;
    *steps = s.steps;
    return plate(&s, &o);
}
