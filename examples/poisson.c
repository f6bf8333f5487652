/* SPDX-License-Identifier: MIT */
/* poisson.c - Poisson's ratio seen: four strips that differ in nothing else are stretched by 1 %.

   A bond-based solid has one constant and so one Poisson ratio. A state-based bond (LPS) also feels how the volume of
   its two families changes: the second constant frees the ratio. The strips are four materials of one body, a
   horizon apart. Writes out/poisson.png, displacements 12 times too large; colour: change of area. */
#include "picture.h"

int main(void) {
    const double ratio[4] = {0.0, 0.15, 0.30, 0.45}, h = 1e-3, lx = 0.08, ly = 0.02, pitch = 0.026; /* [m] */
    const double pull[2] = {0.01 * (lx - h) / 2, 0}, push[2] = {-0.01 * (lx - h) / 2, 0}; /* the ends are rows of centres */
    peri_body_desc desc;
    peri_material_desc polymer;
    peri_advance_desc run;
    int k;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 3 * h;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.correction = PERI_CORRECTION_MOMENT; /* exact moduli although a family has only 28 points */
    peri_body *strips = must_create(&desc);
    for (k = 0; k < 4; ++k) {
        const double lo[2] = {0, k * pitch}, hi[2] = {lx, k * pitch + ly};
        peri_material_desc_init(&polymer, PERI_LAW_LPS);
        polymer.young = 2e9; /* [Pa] */
        polymer.poisson = ratio[k];
        polymer.density = 1200; /* [kg/m^3] */
        const int32_t material = must(strips, peri_add_material(strips, &polymer));
        must(strips, peri_add_box(strips, material, lo, hi, h));
    }
    must(strips, peri_build(strips));

    /* The ends move apart and are free to slide sideways; damping brings the strips to rest. */
    const double left_lo[2] = {0, 0}, left_hi[2] = {h, 4 * pitch}, right_lo[2] = {lx - h, 0}, right_hi[2] = {lx, 4 * pitch};
    const int32_t left = must(strips, peri_select_box(strips, "left", left_lo, left_hi));
    const int32_t right = must(strips, peri_select_box(strips, "right", right_lo, right_hi));
    const int32_t grip = must(strips, peri_prescribe_displacement(strips, right, PERI_AXIS_X, pull, NULL, NULL));
    must(strips, peri_prescribe_displacement(strips, left, PERI_AXIS_X, push, NULL, NULL));
    peri_advance_desc_init(&run);
    run.duration = 1.2e-3; /* [s]: a wave crosses 20 times */
    run.damping = 6e4;     /* [1/s] */
    must(strips, peri_advance(strips, &run));

    const int64_t count = peri_size_of_field(strips, PERI_FIELD_STRAIN);
    double *strain = (double *)malloc((size_t)count * sizeof *strain), force[2]; /* xx yy xy of each point */
    if (!strain) return EXIT_FAILURE;
    must(strips, peri_get_field(strips, PERI_FIELD_STRAIN, strain, count));
    for (k = 0; k < 4; ++k) {
        const double *middle = strain + 3 * (k * 1600 + 10 * 80 + 40);
        printf("nu = %.2f: the middle is stretched by %.3f %% and %s by %.3f %%, ratio %.3f\n", ratio[k], 100 * middle[0],
               middle[1] <= 0 ? "narrowed" : "widened", 100 * fabs(middle[1]), -middle[1] / middle[0]);
    }
    must(strips, peri_get_reaction(strips, grip, force));
    printf("force on the four grips %.0f N, by Hooke's law %.0f N\n", force[0], 4 * 2e9 * 0.01 * ly);
    must(strips, picture("out/poisson.png", strips, PERI_FIELD_DILATATION, "dilatation", 0, 0.01, 900, 12));
    free(strain);
    peri_body_destroy(strips);
    return 0;
}
