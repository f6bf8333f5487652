/* SPDX-License-Identifier: MIT */
/* concrete.c - a notched concrete beam smaller than its fracture process zone: bonds that soften.

   Beam 175 x 50 x 50 mm, span 125 mm, notch of half the depth; E = 37 GPa, strength 3.9 MPa, fracture energy 143.2 J/m^2. Measured:
   peaks of 930 to 1110 N, and 170 to 410 N left at a notch opening of 0.2 mm. E G/strength^2 = 0.35 m is seven times the depth: by its
   energy alone the beam would bear 4 kN, by its strength alone half a kN. The curve of softening falls steeply to a tenth of the strength,
   which then lasts: chosen after the tail; the peak follows. Writes out/concrete.csv. */
#include "example.h"

#define STEPS 16
typedef struct beam {
    FILE   *csv;
    int32_t load, left, right;
    double  peak, tail;
} beam;

static int32_t record(void *user, peri_body *body) {
    beam *c = (beam *)user;
    peri_view u;
    double force[2];
    must(body, peri_get_reaction(body, c->load, force));
    must(body, peri_view_field(body, PERI_FIELD_DISPLACEMENT, &u));
    const double *x = (const double *)u.data;
    const double opening = u.scale * (x[c->right * u.point_stride] - x[c->left * u.point_stride]);
    fprintf(c->csv, "%.2f,%.1f\n", opening * 1e6, -force[1]);
    if (-force[1] > c->peak) c->peak = -force[1];
    if (opening < 0.2e-3) c->tail = -force[1];
    return 0;
}

int main(void) {
    const double h = 0.0025, lo[2] = {0, 0}, hi[2] = {0.175, 0.05}, mouth[2] = {0.0875, -h}, tip[2] = {0.0875, 0.025};
    const double left[2] = {0.025, 0.5 * h}, right[2] = {0.15, 0.5 * h}, top[2] = {0.0875, 0.05 - 0.5 * h}, down[2] = {0, -1.4e-4};
    const double lip[2][2] = {{0.0875 - 0.5 * h, 0.5 * h}, {0.0875 + 0.5 * h, 0.5 * h}};
    const double curve[6] = {0, 1, 0.038, 0.1, 1, 0}; /* opening of bonds of any scale, force over the strength            */
    peri_body_desc desc;
    peri_material_desc concrete;
    peri_softening_desc softening;
    peri_solve_desc solve;
    beam c = {0};
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.horizon = 3 * h;
    desc.thickness = 0.05;
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&concrete, PERI_LAW_BOND_BASED);
    concrete.young = 37e9;
    concrete.density = 2346;
    const int32_t material = must(body, peri_add_material(body, &concrete));
    peri_softening_desc_init(&softening, PERI_SOFTENING_TABLE);
    softening.strength = 3.9e6;
    softening.fracture_energy = 143.2;
    softening.count = 3;
    softening.table = curve;
    must(body, peri_set_softening(body, material, material, &softening));
    must(body, peri_add_box(body, material, lo, hi, h));
    must(body, peri_build(body));
    must(body, peri_cut_segment(body, PERI_CUT_INITIAL, mouth, tip));
    for (int k = 0; k < 2; ++k) must(body, peri_set_no_fail(body, must(body, peri_select_ball(body, NULL, k ? left : right, 2 * h)), 1));
    must(body, peri_prescribe_displacement(body, must(body, peri_select_ball(body, NULL, left, 0.8 * h)), PERI_AXIS_XY, NULL, NULL, NULL));
    must(body, peri_prescribe_displacement(body, must(body, peri_select_ball(body, NULL, right, 0.8 * h)), PERI_AXIS_Y, NULL, NULL, NULL));
    const int32_t pushed = must(body, peri_select_ball(body, NULL, top, 0.8 * h));
    c.load = must(body, peri_prescribe_displacement(body, pushed, PERI_AXIS_Y, down, NULL, NULL));
    c.left = must(body, peri_find_point(body, lip[0]));
    c.right = must(body, peri_find_point(body, lip[1]));
    c.csv = fopen("out/concrete.csv", "w");
    if (c.csv == NULL) return 1;
    fprintf(c.csv, "opening [um],load [N]\n");
    peri_solve_desc_init(&solve);
    solve.steps = STEPS;
    solve.on_step = record;
    solve.user = &c;
    must(body, peri_solve(body, &solve, NULL));
    (void)fclose(c.csv);
    printf("peak %.0f N (measured 930 to 1110 N), %.0f N left at 0.2 mm (170 to 410 N)\n", c.peak, c.tail);
    peri_body_destroy(body);
    return !(c.peak > 750 && c.peak < 1350 && c.tail > 170 && c.tail < 410);
}
