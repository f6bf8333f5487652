/* SPDX-License-Identifier: MIT */
/* closed_crack.c - a slab with a crack, pulled and pressed: open the crack weakens it, closed it carries.

   Without contact the faces of a closed crack pass through each other, and the slab is as soft pressed as it is pulled.
   A centre crack of length 2a in a slab of width W takes the energy of the field that it frees: by LEFM, K = sigma sqrt(pi a)
   sqrt(sec(pi a/W)), the slab lengthens by a further -(4 W sigma/(pi E)) ln cos(pi a/W).
   Writes out/closed_crack.png (displacement along the load, deformed 400 times) of the slab that is pulled. */
#include "picture.h"

static const double width = 0.1, height = 0.2, h = 2.5e-3, young = 30e9, a = 0.025; /* [m], [Pa]                        */

/* The mean stress [Pa] over the strain of the slab between its grips, in units of E. */
static double stiffness(int cracked, int touches, double strain, const char *path) {
    const double lo[2] = {0, 0}, hi[2] = {width, height}, move[2] = {0, strain * height};
    const double left[2] = {0.5 * width - a, 0.5 * height}, right[2] = {0.5 * width + a, 0.5 * height};
    const double bottom[2] = {width, 2 * h}, top[2] = {0, height - 2 * h};
    double force[2];
    peri_body_desc desc;
    peri_material_desc concrete;
    peri_contact_desc contact;
    peri_solve_desc statics;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 3 * h;
    desc.correction = PERI_CORRECTION_MOMENT; /* E is that of the slab up to its edges */
    peri_body *slab = must_create(&desc);
    peri_material_desc_init(&concrete, PERI_LAW_LPS);
    concrete.young = young, concrete.poisson = 0.2, concrete.density = 2400;
    must(slab, peri_add_material(slab, &concrete));
    must(slab, peri_add_box(slab, peri_id(slab, PERI_KIND_MATERIAL, 1), lo, hi, h));
    must(slab, peri_build(slab));
    if (cracked) must(slab, peri_cut_segment(slab, PERI_CUT_INITIAL, left, right));
    peri_contact_desc_init(&contact);
    contact.stiffness = 2; /* as stiff as the bonds that it replaces, nearly */
    if (touches) must(slab, peri_set_contact(slab, PERI_ALL, PERI_ALL, &contact));
    const int32_t held = must(slab, peri_select_box(slab, "bottom", lo, bottom));
    const int32_t moved = must(slab, peri_select_box(slab, "top", top, hi));
    must(slab, peri_prescribe_displacement(slab, held, PERI_AXIS_XY, NULL, NULL, NULL));
    const int32_t grip = must(slab, peri_prescribe_displacement(slab, moved, PERI_AXIS_XY, move, NULL, NULL));
    peri_solve_desc_init(&statics);
    must(slab, peri_solve(slab, &statics, NULL));
    must(slab, peri_get_reaction(slab, grip, force));
    if (path) must(slab, picture(path, slab, PERI_FIELD_DISPLACEMENT, "displacement", 0, strain * height, 500, 400));
    peri_body_destroy(slab);
    return force[1] / width / strain / young;
}

int main(void) {
    const double whole = stiffness(0, 1, 1e-4, NULL);
    const double open = stiffness(1, 1, 1e-4, "out/closed_crack.png");
    const double closed = stiffness(1, 1, -1e-4, NULL), ghostly = stiffness(1, 0, -1e-4, NULL);
    const double pi = 3.14159265358979, free_height = height - 4 * h;
    const double expected = 1 / (1 - 4 * width / (pi * free_height) * log(cos(pi * a / width)));
    printf("pulled: %.3f of the whole slab (linear fracture mechanics: %.3f)\n", open / whole, expected);
    printf("pressed: %.3f; without contact %.3f\n", closed / whole, ghostly / whole);
    return !(fabs(open / whole - expected) < 0.05 && fabs(closed / whole - 1) < 0.02 && ghostly / whole < 0.9);
}
