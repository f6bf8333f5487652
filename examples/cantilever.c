/* SPDX-License-Identifier: MIT */
/* cantilever.c - a steel bar, built in at one end, bends under a force at the other: how far, and how much stress?

   200 mm x 10 mm, 5 mm thick, F = 100 N. Timoshenko: w(x) = F x^2 (3 L - x)/(6 E I) + F x/(k G A), k = 5/6; stress -M y/I.
   The correspondence law works with the strain of each family of points, F = (sum w Y xi V) K^-1, and any Poisson ratio. Families at
   a face lie to one side, which makes bars soft in bending; a stabilization of 0.4 makes up for it. Written to out/cantilever.vtu. */
#include "example.h"

enum { COLUMNS = 400, ROWS = 20, GRIP = 6, ALL = COLUMNS + GRIP };

int main(void) {
    const double length = 0.2, depth = 0.01, thickness = 0.005, force = -100; /* [m], [N] */
    const double young = 210e9, poisson = 0.3, shear = young / (2 * (1 + poisson)), h = depth / ROWS, horizon = 3 * h;
    const double inertia = thickness * pow(depth, 3) / 12, area = thickness * depth;
    const double lo[2] = {-GRIP * h, -depth / 2}, hi[2] = {length, depth / 2};
    const double wall[2] = {0, depth / 2}, end[2] = {length - 2 * horizon, -depth / 2};
    const double out[2] = {1, 0}, traction[2] = {0, force / area};
    static double x[ROWS * ALL][2], u[ROWS * ALL][2], stress[ROWS * ALL][3];
    peri_body_desc desc;
    peri_material_desc steel;
    peri_solve_desc statics;
    peri_solve_report report;
    double reaction[2], error = 0;
    int tenth;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.thickness = thickness;
    desc.horizon = horizon;
    desc.geometry = PERI_GEOMETRY_LINEAR; /* small displacements: one linear system */
    desc.influence = PERI_INFLUENCE_POWER_3;
    peri_body *bar = must_create(&desc);
    peri_material_desc_init(&steel, PERI_LAW_CORRESPONDENCE);
    steel.young = young;
    steel.poisson = poisson;
    steel.density = 7850; /* [kg/m^3] */
    steel.stabilization = 0.4;
    const int32_t material = must(bar, peri_add_material(bar, &steel));
    must(bar, peri_add_box(bar, material, lo, hi, h));
    must(bar, peri_build(bar));

    /* The wall holds two horizons of bar: points feel what moves that far away. The force is spread over the end face likewise. The
       last held points are the centres at x = -h/2, from where on the bar bends: 1.5 h/length = 0.4 % more at the tip. With
       wall[0] = h, one column more, it bends from h/2 on. */
    const int32_t in_wall = must(bar, peri_select_box(bar, "wall", lo, wall)), at_end = must(bar, peri_select_box(bar, "end", end, hi));
    const int32_t held = must(bar, peri_prescribe_displacement(bar, in_wall, PERI_AXIS_XY, NULL, NULL, NULL));
    must(bar, peri_apply_traction(bar, at_end, depth, out, traction, NULL, NULL));

    peri_solve_desc_init(&statics);
    must(bar, peri_solve(bar, &statics, &report));
    must(bar, peri_get_field(bar, PERI_FIELD_POSITION, x[0], ROWS * ALL * 2));
    must(bar, peri_get_field(bar, PERI_FIELD_DISPLACEMENT, u[0], ROWS * ALL * 2));
    must(bar, peri_get_field(bar, PERI_FIELD_STRESS, stress[0], ROWS * ALL * 3));
    must(bar, peri_get_reaction(bar, held, reaction));

    printf("   x [mm]   deflection [mm]   beam theory    stress in row 19 of 20 [MPa]   beam theory\n");
    for (tenth = 1; tenth <= 10; ++tenth) {
        const int column = GRIP + COLUMNS * tenth / 10 - 1, axis = ROWS / 2 * ALL + column, row = (ROWS - 2) * ALL + column;
        const double at = x[axis][0], w = force * at * (at * (3 * length - at) / (6 * young * inertia) + 1.2 / (shear * area));
        error = u[axis][1] / w - 1; /* at the tip, in the end */
        printf("   %6.1f   %15.4f   %11.4f   %28.2f   %11.2f\n", 1e3 * at, 1e3 * u[axis][1], 1e3 * w, 1e-6 * stress[row][0],
               -1e-6 * force * (length - at) * x[row][1] / inertia);
    }
    printf("The tip goes %.2f %% further than in beam theory; the wall gives %.3f N. %ld iterations.\n", 100 * error, reaction[1],
           (long)report.iterations);
    must(bar, peri_export_vtu(bar, "out/cantilever.vtu"));
    peri_body_destroy(bar);
    return 0;
}
