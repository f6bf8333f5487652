/* SPDX-License-Identifier: MIT */
/* branching.c - a crack in a pane of glass speeds up under tension and splits in two.

   A pane of soda-lime glass, 100 mm x 40 mm, is notched from the left edge to the middle. From t = 0 its long edges
   are pulled apart with 2 MPa. A bond breaks for good at the stretch s0, chosen such that all bonds across a unit of
   area together take the fracture energy G0: in plane stress s0^2 = 4 pi G0/(9 E horizon).
   Writes out/branching.png (damage), out/branching.vtu and the energies over time to out/branching.csv. */
#include "picture.h"
#include <time.h>

static int32_t watch(void *user, peri_body *body) {
    (void)user;
    progress("branching", body, 43e-6);
    must(body, peri_export_history(body, "out/branching.csv", 1));
    return 0; /* go on */
}

int main(void) {
    const double lx = 0.05, ly = 0.02, h = 0.1 / 300, horizon = 1e-3; /* half sides, spacing, horizon [m] */
    const double lo[2] = {-lx, -ly}, hi[2] = {lx, ly}, edge[2] = {-lx, 0}, middle[2] = {0, 0};
    const double upper_row[2] = {-lx, ly - h}, lower_row[2] = {lx, h - ly}, up[2] = {0, 2e6}, down[2] = {0, -2e6};
    const double upper_zone[2] = {-lx, ly - horizon}, lower_zone[2] = {lx, horizon - ly};
    const clock_t start = clock();
    peri_body_desc desc;
    peri_material_desc glass;
    peri_advance_desc run;
    peri_picture_desc view;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = horizon;
    peri_body *pane = must_create(&desc);
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 72e9;          /* [Pa] */
    glass.density = 2440;        /* [kg/m^3] */
    glass.fracture_energy = 3.8; /* [J/m^2] */
    const int32_t material = must(pane, peri_add_material(pane, &glass));
    must(pane, peri_add_box(pane, material, lo, hi, h)); /* 300 x 120 points */
    must(pane, peri_build(pane));
    must(pane, peri_cut_segment(pane, PERI_CUT_INITIAL, edge, middle));

    /* The load acts on the outermost rows, each 0.1 m long; bonds near them must not break, or the rows come off. */
    const int32_t upper = must(pane, peri_select_box(pane, "upper row", upper_row, hi));
    const int32_t lower = must(pane, peri_select_box(pane, "lower row", lo, lower_row));
    must(pane, peri_apply_layer_traction(pane, upper, 0.1, up, NULL, NULL));
    must(pane, peri_apply_layer_traction(pane, lower, 0.1, down, NULL, NULL));
    const int32_t near_upper = must(pane, peri_select_box(pane, "upper zone", upper_zone, hi));
    const int32_t near_lower = must(pane, peri_select_box(pane, "lower zone", lo, lower_zone));
    must(pane, peri_set_no_fail(pane, near_upper, 1));
    must(pane, peri_set_no_fail(pane, near_lower, 1));

    peri_advance_desc_init(&run);
    run.duration = 43e-6; /* [s], in steps that are stable */
    run.frame_steps = 20;
    run.on_frame = watch;
    must(pane, peri_export_history(pane, "out/branching.csv", 0));
    must(pane, peri_advance(pane, &run));

    printf("%ld points, %ld bonds, %ld cut, %ld broken in %ld steps; %.2f s of processor time\n",
           (long)peri_point_count(pane), (long)peri_bond_count(pane), (long)peri_cut_count(pane),
           (long)peri_broken_count(pane), (long)peri_step_count(pane), (double)(clock() - start) / CLOCKS_PER_SEC);
    print_energy(pane);
    peri_picture_desc_init(&view);
    view.title = "A crack branches in glass (displacements x 20)";
    view.label = "damage", view.hi = 0.6, view.magnify = 20, view.width = 1300;
    view.length_scale = 1e3, view.length_unit = "mm", view.time_scale = 1e6, view.time_unit = "us", view.show_time = 1;
    must(pane, peri_picture_save("out/branching.png", pane, &view));
    must(pane, peri_export_vtu(pane, "out/branching.vtu"));
    peri_body_destroy(pane);
    return 0;
}
