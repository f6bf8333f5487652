/* SPDX-License-Identifier: MIT */
/* hole.c - a steel strip with a round hole is pulled: the stress at the side of the hole is three times that far away.

   Kirsch (1898), infinite plate, across the pull at distance r from the middle of a hole of radius a:
       stress(r) = S (1 + (a/r)^2/2 + 3 (a/r)^4/2)
   A strip five holes wide adds 4.7 % at the rim (Heywood: K = (2 + (1 - d/W)^3)/(1 - d/W) = 3.14 in place of 3).
   The rim itself is a point, and a family there averages over a horizon: compare beyond a horizon from it.
   Writes out/hole.png: the stress along the pull, from 0 (dark) to 3 S (bright). */
#include "picture.h"

static const double radius = 0.01, far_stress = 100e6; /* [m], [Pa]                                                        */
enum { ACROSS = 200, ALONG = 480 };                    /* cells; 20 to a radius                                            */

static int32_t outside_hole(void *user, int64_t index, const double *x) {
    (void)user;
    (void)index;
    return x[0] * x[0] + x[1] * x[1] > radius * radius;
}

int main(void) {
    const double h = radius / 20, hi[2] = {0.5 * ALONG * h, 0.5 * ACROSS * h}, lo[2] = {-hi[0], -hi[1]};
    const double left_end[2] = {lo[0] + 6 * h, hi[1]}, right_end[2] = {hi[0] - 6 * h, lo[1]}, width = 2 * hi[1];
    const double right[2] = {1, 0}, left[2] = {-1, 0}, pull_right[2] = {far_stress, 0}, pull_left[2] = {-far_stress, 0};
    peri_body_desc desc;
    peri_material_desc steel;
    peri_solve_desc statics;
    peri_solve_report report;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.geometry = PERI_GEOMETRY_LINEAR; /* small strains                                                                 */
    desc.horizon = 3 * h;
    peri_body *strip = must_create(&desc);
    peri_material_desc_init(&steel, PERI_LAW_CORRESPONDENCE);
    steel.young = 200e9;
    steel.poisson = 0.3;
    steel.density = 7850;
    const int32_t material = must(strip, peri_add_material(strip, &steel));
    must(strip, peri_add_shape(strip, material, lo, hi, h, outside_hole, NULL));
    must(strip, peri_build(strip));

    /* On the ends: spread over the two horizons that feel them, such that a strip without a hole would be strained evenly. */
    const int32_t at_left = must(strip, peri_select_box(strip, "left end", lo, left_end));
    const int32_t at_right = must(strip, peri_select_box(strip, "right end", right_end, hi));
    must(strip, peri_apply_traction(strip, at_left, width, left, pull_left, NULL, NULL));
    must(strip, peri_apply_traction(strip, at_right, width, right, pull_right, NULL, NULL));
    peri_solve_desc_init(&statics);
    statics.loose = PERI_LOOSE_PINNED; /* nothing holds the strip: the loads balance each other                           */
    must(strip, peri_solve(strip, &statics, &report));

    const int64_t n = peri_point_count(strip);
    double *x = (double *)malloc((size_t)n * 2 * sizeof *x), *stress = (double *)malloc((size_t)n * 3 * sizeof *x);
    if (x == NULL || stress == NULL) return 1;
    must(strip, peri_get_field(strip, PERI_FIELD_POSITION, x, 2 * n));
    must(strip, peri_get_field(strip, PERI_FIELD_STRESS, stress, 3 * n)); /* xx yy xy                                           */
    printf("%ld points, %ld iterations\n", (long)n, (long)report.iterations);
    printf("  r/a   stress/S   Kirsch   Kirsch with the width\n");
    for (int64_t i = 0, row = 0; i < n; ++i) { /* the column at x = h/2, upwards                                            */
        const double q = pow(radius / x[2 * i + 1], 2), kirsch = 1 + q / 2 + 3 * q * q / 2;
        if (x[2 * i] < 0 || x[2 * i] > h || x[2 * i + 1] < radius || row++ % 4 != 0 || q < 0.16) continue;
        printf("%6.3f   %6.3f     %6.3f   %6.3f\n", x[2 * i + 1] / radius, stress[3 * i] / far_stress, kirsch, kirsch * 3.14 / 3);
    }

    peri_picture_desc view;
    peri_picture_desc_init(&view);
    view.field = PERI_FIELD_STRESS, view.component = 0, view.hi = 3 * far_stress, view.field_scale = 1 / far_stress, view.width = 1200;
    view.label = "stress xx / far stress", view.title = "A hole in a strip that is pulled";
    must(strip, peri_picture_save("out/hole.png", strip, &view));
    free(x);
    free(stress);
    peri_body_destroy(strip);
    return 0;
}
