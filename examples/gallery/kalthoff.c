/* SPDX-License-Identifier: MIT */
/* kalthoff.c - Kalthoff and Winkler: a steel plate with two notches is struck between them, and cracks run off at 70 degrees.

   Whole: 100 x 200 mm, notches 50 mm long and 50 mm apart, E 190 GPa, nu 1/4 (plane strain), 8000 kg/m^3, 22.17 kJ/m^2; the projectile,
   at 32 m/s and of the same steel, gives the struck edge half of that. Half: the grid of the thesis, half as large, on one side of the
   line of symmetry, 50 x 50 points, horizon 4 spacings, steps of 125 ns ([T] 5.1). */
#include "gallery.h"

static const double mm = 1e-3;

/* The plate of half height `half` [mm], whole or above its middle only. */
static void strike(const char *name, double h, double m, double size, int whole, double step, FILE *figures) {
    const double width = 100 * size * mm, half = 100 * size * mm, notch = 25 * size * mm, length = 50 * size * mm, low = -1e-9;
    const double lo[2] = {0, whole ? -half : 0}, hi[2] = {width, half}, struck_lo[2] = {0, whole ? -notch : 0}, struck_hi[2] = {h, notch};
    const double push[2] = {16, 0}, above[4] = {low, notch, length, notch}, below[4] = {low, -notch, length, -notch};
    const double row[2] = {width, m * h};
    broken_bonds bonds = {NULL, NULL, 0, 0};
    int64_t strange = 0;
    peri_body_desc desc;
    peri_material_desc steel;
    peri_advance_desc run;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRAIN;
    desc.horizon = m * h;
    if (whole) desc.correction = PERI_CORRECTION_MOMENT;
    peri_body *plate = must_create(&desc);
    peri_material_desc_init(&steel, PERI_LAW_BOND_BASED);
    steel.young = 190e9, steel.density = 8000, steel.fracture_energy = 22170; /* [Pa], [kg/m^3], [J/m^2] */
    const int32_t material = must(plate, peri_add_material(plate, &steel));
    must(plate, peri_add_box(plate, material, lo, hi, h)), must(plate, peri_build(plate));
    must(plate, peri_cut_segment(plate, PERI_CUT_INITIAL, above, above + 2));
    if (whole) must(plate, peri_cut_segment(plate, PERI_CUT_INITIAL, below, below + 2));
    const int32_t struck = must(plate, peri_select_box(plate, "struck", struck_lo, struck_hi));
    must(plate, peri_prescribe_velocity(plate, struck, PERI_AXIS_X, push, NULL, NULL));
    if (!whole) /* the rolling constraint of the thesis: y, of the points along the line of symmetry */
        must(plate, peri_prescribe_velocity(plate, must(plate, peri_select_box(plate, "middle", lo, row)), PERI_AXIS_Y, NULL, NULL, NULL));
    bonds.x = field_of(plate, PERI_FIELD_POSITION);
    must(plate, peri_on_break(plate, note_bond, &bonds));
    peri_advance_desc_init(&run);
    run.duration = 87e-6 * size, run.time_step = step;
    must(plate, peri_advance(plate, &run));
    map_of(name, plate, PERI_FIELD_DAMAGE, 0);

    const double up = direction(&bonds, length, notch, m * h, 30 * size * mm, 0, 1);
    for (int64_t k = 0; k < bonds.count; ++k) strange += bonds.at[3 * k] > width - 3 * m * h;
    if (whole) {
        figure(figures, "crack above", up, 70, 5, "degrees");
        figure(figures, "crack above and below: difference", up + direction(&bonds, length, -notch, m * h, 30 * size * mm, 0, -1), 0, 1,
               "degrees");
        figure(figures, "broken bonds at the far edge", (double)strange, 0, 0.5, "");
    } else {
        figure(figures, "crack on the grid of the thesis", up, 70, 0, "degrees");
        figure(figures, "broken bonds at the far edge on the grid of the thesis", (double)strange, 0, 0, "");
    }
    free((void *)bonds.x);
    free(bonds.at);
    peri_body_destroy(plate);
}

int main(void) {
    FILE *figures = figures_of("kalthoff");
    strike("kalthoff_whole", 0.5 * mm, 3, 1, 1, 0, figures);
    strike("kalthoff_half", 1 * mm, 4, 0.5, 0, 125e-9, figures);
    fclose(figures);
    return 0;
}
