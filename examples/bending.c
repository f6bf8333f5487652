/* SPDX-License-Identifier: MIT */
/* bending.c - a notched concrete beam in three-point bending: a crack without inertia, driven by a prescribed displacement.

   Each step ends in equilibrium: a bond that is stretched over its limit breaks, and equilibrium is sought again, until none is. Griffith:
   a crack grows where the energy that it would release, K^2/E per area, is the fracture energy G0. With ASTM E399,
   K = P S/(B W^1.5) f(a/W), that makes a peak load. A notch of half the depth softens then; below 0.3 the beam would snap.
   Writes out/bending.csv (the curve) and out/bending.png (damage, deflection magnified). */
#include "picture.h"

#define STEPS 62
static double curve[STEPS][6]; /* load factor, mean displacement x y [m], force x y [N], broken bonds                      */
int main(void) {
    const double depth = 0.15, span = 0.595, thickness = 0.15, h = 0.005, deflection = 62e-6; /* [m]                       */
    const double young = 35.77e9, fracture_energy = 9.8, notch = 0.5;                         /* [Pa], [J/m^2], of the depth */
    const double lo[2] = {-0.31, 0}, hi[2] = {0.31, depth}, below[2] = {0, -h}, tip[2] = {0, notch * depth};
    const double left[2] = {-0.5 * span, 0.5 * h}, right[2] = {0.5 * span, 0.5 * h}, top[2] = {0, depth - 0.5 * h};
    const double down[2] = {0, -deflection};
    peri_body_desc desc;
    peri_material_desc concrete;
    peri_solve_desc statics;
    peri_energy e;
    double peak = 0;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.geometry = PERI_GEOMETRY_LINEAR; /* the deflection is 1/10000 of the span                                         */
    desc.horizon = 3 * h;
    desc.thickness = thickness;
    desc.threads = 1; /* few points: threads would wait for each other                                                     */
    peri_body *beam = must_create(&desc);
    peri_material_desc_init(&concrete, PERI_LAW_BOND_BASED);
    concrete.young = young;
    concrete.density = 2400;
    concrete.fracture_energy = fracture_energy;
    const int32_t material = must(beam, peri_add_material(beam, &concrete));
    must(beam, peri_add_box(beam, material, lo, hi, h)); /* 124 x 30 points          */
    must(beam, peri_build(beam));
    must(beam, peri_cut_segment(beam, PERI_CUT_INITIAL, below, tip));

    /* Two points carry the beam and two push it down: nothing breaks within a horizon of them. */
    must(beam, peri_set_no_fail(beam, must(beam, peri_select_ball(beam, "by the left support", left, 3 * h)), 1));
    must(beam, peri_set_no_fail(beam, must(beam, peri_select_ball(beam, "by the right support", right, 3 * h)), 1));
    must(beam, peri_set_no_fail(beam, must(beam, peri_select_ball(beam, "by the load", top, 3 * h)), 1));
    const int32_t hinge = must(beam, peri_select_ball(beam, "left support", left, 0.6 * h));
    const int32_t roller = must(beam, peri_select_ball(beam, "right support", right, 0.6 * h));
    const int32_t pushed = must(beam, peri_select_ball(beam, "load", top, 0.6 * h));
    must(beam, peri_prescribe_displacement(beam, hinge, PERI_AXIS_XY, NULL, NULL, NULL));
    must(beam, peri_prescribe_displacement(beam, roller, PERI_AXIS_Y, NULL, NULL, NULL));
    const int32_t load = must(beam, peri_prescribe_displacement(beam, pushed, PERI_AXIS_Y, down, NULL, NULL));

    peri_solve_desc_init(&statics);
    statics.steps = STEPS;
    statics.curve_load = load;
    statics.curve = curve[0];
    statics.curve_rows = STEPS;
    must(beam, peri_solve(beam, &statics, NULL));

    FILE *csv = fopen("out/bending.csv", "w");
    if (csv == NULL) return 1;
    fprintf(csv, "deflection [um],load [N],broken bonds\n");
    for (int k = 0; k < STEPS; ++k) {
        fprintf(csv, "%.2f,%.1f,%.0f\n", -1e6 * curve[k][2], -curve[k][4], curve[k][5]);
        peak = fmax(peak, -curve[k][4]);
    }
    if (fclose(csv) != 0) must(beam, PERI_ERROR_WRITE);

    const double f = 3 * sqrt(notch) * (1.99 - notch * (1 - notch) * (2.15 - 3.93 * notch + 2.7 * notch * notch)) /
                     (2 * (1 + 2 * notch) * pow(1 - notch, 1.5)); /* ASTM E399, span = 4 depths                            */
    const double griffith = sqrt(young * fracture_energy) * thickness * pow(depth, 1.5) / (span * f);
    must(beam, peri_get_energy(beam, &e));
    printf("peak load %.0f N; linear fracture mechanics, for a sharp crack and no lattice: %.0f N\n", peak, griffith);
    printf("at %.0f um the load is down to %.0f N\n", -1e6 * curve[STEPS - 1][2], -curve[STEPS - 1][4]);
    /* 18 bonds cross the middle per row of points at horizon 3 h. More than G0 is lost as the crack leaps from row to row. */
    printf("the crack took %.1f mJ, %.1f mJ of it in bonds; G0 times its area is %.1f mJ\n", 1e3 * (e.external - e.elastic),
           1e3 * e.fracture, 1e3 * fracture_energy * thickness * h * curve[STEPS - 1][5] / 18);
    must(beam, picture("out/bending.png", beam, PERI_FIELD_DAMAGE, "damage", 0, 0.6, 1300, 300));
    peri_body_destroy(beam);
    return 0;
}
