/* SPDX-License-Identifier: MIT */
/* softening.c - a concrete beam with a short notch snaps in three-point bending: as its crack grows load and deflection both go back, so
   that no load and no prescribed deflection can hold it. Fracture control can: the load factor is where the next bond meets its criterion.

   Griffith: a crack grows where the energy that it would release, K^2/E per area, is the fracture energy G0; with ASTM E399,
   K = P S/(B W^1.5) f(a/W), that makes a peak load. Writes out/softening.csv (the curve) and out/softening.png (damage). */
#include "picture.h"

#define ROWS 300
static double curve[ROWS][6]; /* load factor, mean displacement x y [m], force x y [N], broken bonds                       */

int main(void) {
    const double depth = 0.15, span = 0.595, thickness = 0.15, h = 0.005, young = 35.77e9, g0 = 9.8, notch = 0.2;
    const double lo[2] = {-0.31, 0}, hi[2] = {0.31, depth}, below[2] = {0, -h}, tip[2] = {0, notch * depth};
    const double down[2] = {0, -60e-6}, place[3][2] = {{-0.5 * span, 0.5 * h}, {0.5 * span, 0.5 * h}, {0, depth - 0.5 * h}};
    peri_body_desc desc;
    peri_material_desc concrete;
    peri_solve_desc solve;
    peri_solve_report report;
    peri_energy e;
    int32_t held[3];
    double peak = 0, at = 0, back = 1, area = 0;
    int k;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.horizon = 3 * h;
    desc.thickness = thickness;
    desc.threads = 1; /* few points: threads would wait for each other                                                     */
    peri_body *beam = must_create(&desc);
    peri_material_desc_init(&concrete, PERI_LAW_BOND_BASED);
    concrete.young = young;
    concrete.density = 2400;
    concrete.fracture_energy = g0;
    must(beam, peri_add_box(beam, must(beam, peri_add_material(beam, &concrete)), lo, hi, h));
    must(beam, peri_build(beam));
    must(beam, peri_cut_segment(beam, PERI_CUT_INITIAL, below, tip));
    for (k = 0; k < 3; ++k) { /* two points carry the beam and two push it down: nothing breaks within a horizon of them      */
        must(beam, peri_set_no_fail(beam, must(beam, peri_select_ball(beam, NULL, place[k], 3 * h)), 1));
        held[k] = must(beam, peri_select_ball(beam, NULL, place[k], 0.6 * h));
        held[k] = must(beam, peri_prescribe_displacement(beam, held[k], k == 0 ? PERI_AXIS_XY : PERI_AXIS_Y, k == 2 ? down : NULL, NULL,
                                                         NULL));
    }

    peri_solve_desc_init(&solve);
    solve.control = PERI_CONTROL_FRACTURE;
    solve.breaks = 100; /* a crack over most of the depth                                                                  */
    solve.curve_load = held[2];
    solve.curve = curve[0];
    solve.curve_rows = ROWS;
    must(beam, peri_solve(beam, &solve, &report));

    FILE *csv = fopen("out/softening.csv", "w");
    if (csv == NULL) return 1;
    fprintf(csv, "deflection [um],load [N],broken bonds\n");
    for (k = 0; k < report.curve_rows && k < ROWS; ++k) {
        const double load = -curve[k][4], deflection = -curve[k][2];
        fprintf(csv, "%.3f,%.1f,%.0f\n", 1e6 * deflection, load, curve[k][5]);
        area += 0.5 * (load + (k > 0 ? -curve[k - 1][4] : 0)) * (deflection + (k > 0 ? curve[k - 1][2] : 0));
        if (load > peak) at = deflection;
        peak = fmax(peak, load);
        back = fmin(back, load < peak ? deflection : at);
    }
    if (fclose(csv) != 0) must(beam, PERI_ERROR_WRITE);
    const double f = 3 * sqrt(notch) * (1.99 - notch * (1 - notch) * (2.15 - 3.93 * notch + 2.7 * notch * notch)) /
                     (2 * (1 + 2 * notch) * pow(1 - notch, 1.5)); /* ASTM E399, span = 4 depths                            */
    must(beam, peri_get_energy(beam, &e));
    printf("peak load %.0f N at %.1f um; linear fracture mechanics %.0f N\n", peak, 1e6 * at,
           sqrt(young * g0) * thickness * pow(depth, 1.5) / (span * f));
    printf("the deflection goes back to %.1f um; at the end the load is %.0f N\n", 1e6 * back, -curve[report.curve_rows - 1][4]);
    printf("work %.2f mJ = elastic %.2f + fracture %.2f\n", 1e3 * area, 1e3 * e.elastic, 1e3 * e.fracture);
    must(beam, picture("out/softening.png", beam, PERI_FIELD_DAMAGE, "damage", 0, 0.6, 1300, 300));
    peri_body_destroy(beam);
    return report.ended == PERI_ENDED_BREAKS && fabs(area - e.elastic - e.fracture) < 1e-6 * area ? 0 : 1;
}
