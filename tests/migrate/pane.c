/* SPDX-License-Identifier: MIT */
/* A pane of glass pulled until a crack runs, as it was written for peri 0.1: materials and sets by plain number, callbacks without a result,
   a cut whose standing follows from when it is made. */
#include "peri.h"
#include <stdio.h>
#include <stdlib.h>

static int64_t breaks;

static void count_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)user;
    (void)i;
    (void)j;
    if (time > 0 && stretch > 0) ++breaks;
}

static void ramp(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const double factor = time < 1e-6 ? time / 1e-6 : 1.0;
    (void)user;
    (void)points;
    for (int64_t k = 0; k < 2 * count; ++k) value[k] *= factor;
}

static int32_t frame(void *user, peri_body *body) {
    double *damage = (double *)user;
    return peri_read(body, PERI_DAMAGE, damage, peri_field_size(body, PERI_DAMAGE)) < 0;
}

int main(void) {
    const double lo[2] = {0, 0}, hi[2] = {0.02, 0.01}, edge[2] = {0, 0.005}, tip[2] = {0.01, 0.005}, up[2] = {0, 2e7};
    const double row[2] = {0, 0.0095}, foot[2] = {0.02, 0.0005}, from[2] = {0.015, 0.002}, to[2] = {0.015, 0.004};
    peri_body_desc d;
    peri_material glass;
    peri_run run;
    peri_error error;
    peri_body *pane;
    char text[200];
    peri_body_desc_init(&d);
    d.space = PERI_PLANE_STRESS;
    d.precision = PERI_F32;
    d.horizon = 1.5e-3;
    d.quadrature = PERI_FULL_VOLUME;
    if (peri_body_create(&d, &pane, &error) < 0) return 1;
    peri_material_init(&glass, PERI_BOND_BASED);
    glass.young = 72e9;
    glass.density = 2440;
    glass.fracture_energy = 3.8;
    peri_add_material(pane, &glass);
    peri_add_box(pane, 0, lo, hi, 0.5e-3);
    peri_build(pane);
    peri_cut_segment(pane, edge, tip);
    const int32_t top = peri_select_box(pane, "top", row, hi), bottom = peri_select_box(pane, "bottom", lo, foot);
    peri_apply_traction(pane, top, 0.02, up, ramp, NULL);
    peri_prescribe_velocity(pane, bottom, PERI_X | PERI_Y, NULL, NULL, NULL);
    peri_set_no_fail(pane, bottom, 1);
    peri_on_break(pane, count_break, NULL);

    double *damage = (double *)malloc(sizeof *damage * (size_t)peri_field_size(pane, PERI_DAMAGE));
    peri_run_init(&run);
    run.integrator = PERI_CENTRAL_DIFFERENCE;
    run.duration = 4e-6;
    run.frame_steps = 10;
    run.on_frame = frame;
    run.user = damage;
    if (!damage || peri_advance(pane, &run) < 0) {
        peri_last_error(pane, &error);
        peri_error_format(&error, text, sizeof text);
        printf("%s\n", text);
        return 1;
    }
    const int64_t later = peri_cut_segment(pane, from, to); /* after a step: counts as broken */
    const int64_t broken = peri_broken_count(pane);
    peri_reset(pane);
    printf("%d bonds broke, %d were cut later, %d are left broken\n", (int)breaks, (int)later, (int)peri_broken_count(pane));
    free(damage);
    const int fine = later > 0 && broken == breaks + later && peri_broken_count(pane) == 0 && peri_cut_count(pane) > 0;
    peri_body_destroy(pane);
    return !fine;
}
