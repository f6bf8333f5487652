/* SPDX-License-Identifier: MIT */
#include "peri.h"
#include <stdio.h>

static void pull(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user;
    (void)points;
    for (int64_t k = 0; k < count; ++k) value[2 * k] = time;
}

int main(void) {
    const double lo[2] = {0, 0}, hi[2] = {20, 10}, grip[2] = {3, 10}, side[2] = {17, 0}, from[2] = {10, 0}, to[2] = {10, 4};
    peri_body_desc d;
    peri_material m;
    peri_run r;
    peri_body *b;
    peri_body_desc_init(&d);
    d.space = PERI_PLANE_STRESS;
    d.horizon = 3;
    if (peri_body_create(&d, &b, NULL) < 0) return 1;
    peri_material_init(&m, PERI_BOND_BASED);
    m.young = m.density = 1;
    peri_add_material(b, &m);
    peri_add_box(b, 0, lo, hi, 1);
    if (peri_build(b) < 0) return 1;
    peri_prescribe_velocity(b, peri_select_box(b, "left", lo, grip), PERI_X | PERI_Y, NULL, NULL, NULL);
    peri_prescribe_velocity(b, peri_select_box(b, "right", side, hi), PERI_X, NULL, pull, NULL);
    peri_run_init(&r);
    r.steps = 10;
    if (peri_advance(b, &r) < 0) return 1;
    if (peri_cut_segment(b, from, to) <= 0) return 1; /* damage: healed by peri_reset */
    printf("%d bonds broken\n", (int)peri_broken_count(b));
    peri_reset(b);
    const int healed = peri_broken_count(b) == 0;
    peri_body_destroy(b);
    return !healed;
}
