/* SPDX-License-Identifier: MIT */
/* hello.c - pull a steel bar at both ends and compare its elongation with Hooke's law, dl = (stress/E) l.
   cc -O2 examples/hello.c peri_impl.c -lm

   A bond pulls along its own line only, whatever the other bonds do. One bond constant c(E) then carries tension and
   shear alike, which fixes Poisson's ratio: 1/3 in plane stress, 1/4 in 3D and in plane strain. */
#include "../peri.h"
#include <stdio.h>

int main(void) {
    const double h = 1e-3, lo[2] = {0, 0}, hi[2] = {0.1, 0.04}; /* spacing and corners [m]: 100 x 40 points */
    const double left_hi[2] = {1e-3, 0.04}, right_lo[2] = {0.099, 0}, left[2] = {-100e6, 0}, right[2] = {100e6, 0};
    peri_body_desc desc;
    peri_material_desc steel;
    peri_advance_desc run;
    peri_body *bar;
    double u[4000][2]; /* displacements [m] */

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 3 * h;                      /* every point is joined to all points within it */
    desc.quadrature = PERI_QUADRATURE_PARTIAL; /* cells across the edge of the horizon count in part */
    if (peri_body_create(&desc, &bar, NULL) < 0) return 1;
    peri_material_desc_init(&steel, PERI_LAW_BOND_BASED);
    steel.young = 210e9;  /* [Pa] */
    steel.density = 7850; /* [kg/m^3] */
    const int32_t material = peri_add_material(bar, &steel);
    peri_add_box(bar, material, lo, hi, h);
    peri_build(bar);

    /* 100 MPa on the end faces (0.04 m long in 2D), that is on the outermost columns of points. */
    const int32_t left_end = peri_select_box(bar, "left", lo, left_hi);
    const int32_t right_end = peri_select_box(bar, "right", right_lo, hi);
    peri_apply_layer_traction(bar, left_end, 0.04, left, NULL, NULL);
    peri_apply_layer_traction(bar, right_end, 0.04, right, NULL, NULL);

    peri_advance_desc_init(&run);
    run.duration = 1e-4; /* [s]: a wave crosses the bar five times */
    run.damping = 3e5;   /* [1/s], about critical for the lowest mode: the bar comes to rest */
    if (peri_advance(bar, &run) < 0 || peri_get_field(bar, PERI_FIELD_DISPLACEMENT, u[0], 8000) < 0) return 1;

    /* Gauge marks on the axis (row 20), away from the ends: columns 20 and 80, 60 mm apart. Agreement is to a few
       percent: a sum over 3 cells stands for the integral over the horizon. */
    printf("60 mm grow by %.2f um, by Hooke's law %.2f um\n", 1e6 * (u[2080][0] - u[2020][0]),
           1e6 * 0.06 * 100e6 / 210e9);
    peri_body_destroy(bar);
    return 0;
}
