/* SPDX-License-Identifier: MIT */
/* strength.c - rock under a press: at what stress does it break, and along which planes? Mohr-Coulomb in a block between smooth plates.

   By hand: at 2 c cos(phi)/(1 - sin(phi)), c its cohesion and phi its angle of friction, on planes whose normals are 45 degrees + phi/2
   off the load. The factor of the load is set by the first bonds to break (PERI_CONTROL_FRACTURE); each is the normal of a plane. Prints
   both beside what is found. */
#include "example.h"

typedef struct planes {
    const double *place; /* [points*2] */
    double        angle; /* sum over the bonds that broke */
    int           count;
} planes;

static int32_t note_plane(void *user, int32_t i, int32_t j, double factor, double stretch) {
    planes *p = (planes *)user;
    const double *a = &p->place[2 * i], *b = &p->place[2 * j];
    (void)factor, (void)stretch;
    p->angle += atan2(fabs(b[0] - a[0]), fabs(b[1] - a[1])) * 180 / 3.14159265358979323846;
    p->count++;
    return 0;
}

int main(void) {
    enum { ACROSS = 30, ALONG = 45 };
    const double h = 1e-3, lo[2] = {0, 0}, hi[2] = {ACROSS * h, ALONG * h}; /* [m] */
    const double cohesion = 12e6, phi = 30 * 3.14159265358979323846 / 180;  /* [Pa] */
    const double foot[2] = {ACROSS * h, 3 * h}, head[2] = {0, (ALONG - 3) * h}, down[2] = {0, -0.5e-3};
    double place[2 * ACROSS * ALONG], curve[8][6];
    planes broken = {place, 0, 0};
    peri_body_desc desc;
    peri_material_desc sandstone;
    peri_solve_desc solve;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRAIN;
    desc.horizon = 3 * h;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *block = must_create(&desc);
    peri_material_desc_init(&sandstone, PERI_LAW_CORRESPONDENCE);
    sandstone.young = 15e9; /* [Pa] */
    sandstone.poisson = 0.2;
    sandstone.density = 2300; /* [kg/m^3] */
    sandstone.criterion = PERI_CRITERION_MOHR_COULOMB;
    sandstone.cohesion = cohesion;
    sandstone.friction_angle = phi;
    must(block, peri_add_box(block, must(block, peri_add_material(block, &sandstone)), lo, hi, h));
    must(block, peri_build(block));
    must(block, peri_get_field(block, PERI_FIELD_POSITION, place, 2 * ACROSS * ALONG));
    const int32_t bottom = must(block, peri_select_box(block, "bottom", lo, foot));
    const int32_t top = must(block, peri_select_box(block, "top", head, hi));
    must(block, peri_prescribe_displacement(block, bottom, PERI_AXIS_Y, NULL, NULL, NULL));
    const int32_t press = must(block, peri_prescribe_displacement(block, top, PERI_AXIS_Y, down, NULL, NULL));
    must(block, peri_set_no_fail(block, bottom, 1));
    must(block, peri_set_no_fail(block, top, 1));
    must(block, peri_on_break(block, note_plane, &broken));

    peri_solve_desc_init(&solve);
    solve.control = PERI_CONTROL_FRACTURE;
    solve.loose = PERI_LOOSE_PINNED; /* smooth plates: it may slide sideways */
    solve.breaks = 1;
    solve.curve_load = press;
    solve.curve = curve[0];
    solve.curve_rows = 8;
    must(block, peri_solve(block, &solve, NULL));
    printf("breaks at %.1f MPa, by hand %.1f\n", -curve[0][4] / hi[0] / 1e6, 2 * cohesion * cos(phi) / (1 - sin(phi)) / 1e6);
    printf("normals of %d planes at %.0f degrees to the load, by hand %.0f\n", broken.count, broken.angle / broken.count, 45 + 15.0);
    peri_body_destroy(block);
    return 0;
}
