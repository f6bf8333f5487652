/* SPDX-License-Identifier: MIT */
/* criteria.c - when does a bond break? The same slanted notch under three failure criteria, side by side.

   Left: at a critical stretch. Middle: when the work done on the bond passes w0. Right: when the mean energy of its two
   ends does. All are set by the same fracture energy G0. The plates are three materials of one body, apart from each
   other. The third criterion spreads the damage: neighbouring points share most of their families, so when one bond is
   over its limit those beside it are, too. Writes out/criteria.png (damage) and out/criteria.vtu. */
#include "picture.h"

static int32_t watch(void *user, peri_body *body) {
    progress("criteria", body, *(const double *)user);
    return 0;
}

int main(void) {
    const int32_t criterion[3] = {PERI_CRITERION_STRETCH, PERI_CRITERION_BOND_ENERGY, PERI_CRITERION_NODE_ENERGY};
    const double side = 0.06, h = 1e-3, horizon = 3 * h, pitch = side + 2 * horizon, duration = 340e-6; /* [m], [s] */
    const double up[2] = {0, 0.5}, down[2] = {0, -0.5};                                                /* [m/s] */
    const double lower[2] = {0, 0}, upper[2] = {3 * pitch, side}, foot[2] = {3 * pitch, horizon}, head[2] = {0, side - horizon};
    peri_body_desc desc;
    peri_advance_desc run;
    int k;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.thickness = 5e-3;
    desc.horizon = horizon;
    peri_body *plates = must_create(&desc);
    for (k = 0; k < 3; ++k) {
        const double lo[2] = {k * pitch, 0}, hi[2] = {k * pitch + side, side};
        peri_material_desc plexiglas;
        peri_material_desc_init(&plexiglas, PERI_LAW_LPS);
        plexiglas.young = 2.94e9; /* [Pa] */
        plexiglas.poisson = 0.38;
        plexiglas.density = 1180;        /* [kg/m^3] */
        plexiglas.fracture_energy = 300; /* [J/m^2] */
        plexiglas.criterion = criterion[k];
        const int32_t material = must(plates, peri_add_material(plates, &plexiglas));
        must(plates, peri_add_box(plates, material, lo, hi, h));
    }
    must(plates, peri_build(plates));
    for (k = 0; k < 3; ++k) { /* a notch in the middle, at 45 degrees */
        const double x = k * pitch + side / 2, y = side / 2, half = 0.008;
        const double from[2] = {x - half, y - half}, to[2] = {x + half, y + half};
        must(plates, peri_cut_segment(plates, PERI_CUT_INITIAL, from, to));
    }
    const int32_t top = must(plates, peri_select_box(plates, "top", head, upper));
    const int32_t bottom = must(plates, peri_select_box(plates, "bottom", lower, foot));
    must(plates, peri_prescribe_velocity(plates, top, PERI_AXIS_XY, up, NULL, NULL));
    must(plates, peri_prescribe_velocity(plates, bottom, PERI_AXIS_XY, down, NULL, NULL));
    must(plates, peri_set_no_fail(plates, top, 1));
    must(plates, peri_set_no_fail(plates, bottom, 1));

    peri_advance_desc_init(&run);
    run.duration = duration;
    run.frame_steps = 10;
    run.on_frame = watch;
    run.user = (void *)&duration;
    must(plates, peri_advance(plates, &run));
    printf("%ld bonds broken in %ld steps\n", (long)peri_broken_count(plates), (long)peri_step_count(plates));
    print_energy(plates);
    must(plates, picture("out/criteria.png", plates, PERI_FIELD_DAMAGE, "damage", 0, 0.6, 1000, 3));
    must(plates, peri_export_vtu(plates, "out/criteria.vtu"));
    peri_body_destroy(plates);
    return 0;
}
