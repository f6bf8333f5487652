/* SPDX-License-Identifier: MIT */
/* crush.c - a brittle block falls into a trough, breaks, and comes to rest as a heap.

   Pieces touch each other and the trough, which is made of points that do not move: contact of all materials, with
   friction and with a loss at each bounce. A little damping stands for the air. Writes out/crush.png (damage, where
   the points were) and out/crush.vtu ("Warp By Vector" shows the heap). */
#include "picture.h"

static const double h = 0.01, duration = 0.8; /* [m], [s] */

static int32_t watch(void *user, peri_body *body) {
    (void)user;
    progress("crush", body, duration);
    return 0;
}

/* A box of points; with `fixed` they stay where they are. Returns the set of them. */
static int32_t box(peri_body *body, int32_t material, double x0, double y0, double x1, double y1, int built, int fixed) {
    const double lo[2] = {x0 * h, y0 * h}, hi[2] = {x1 * h, y1 * h};
    if (!built) return must(body, peri_add_box(body, material, lo, hi, h));
    const int32_t set = must(body, peri_select_box(body, NULL, lo, hi));
    if (fixed) must(body, peri_prescribe_displacement(body, set, PERI_AXIS_XY, NULL, NULL, NULL));
    return set;
}

int main(void) {
    const double gravity[2] = {0, -2000 * 9.81}, fall[2] = {0.5, -2};
    double heap = 0;
    peri_body_desc desc;
    peri_material_desc m;
    peri_contact_desc contact;
    peri_advance_desc run;
    peri_energy e;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 3 * h;
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 4e6;      /* [Pa]: soft, so that steps are long */
    m.density = 2000;   /* [kg/m^3] */
    const int32_t ground = must(body, peri_add_material(body, &m));
    m.critical_stretch = 0.01;
    const int32_t brittle = must(body, peri_add_material(body, &m));
    for (int built = 0; built < 2; ++built) {
        if (built) must(body, peri_build(body));
        (void)box(body, ground, -20, -6, 50, -4, built, 1);
        (void)box(body, ground, -22, -6, -20, 40, built, 1);
        (void)box(body, ground, 50, -6, 52, 40, built, 1);
        const int32_t block = box(body, brittle, 0, 0, 30, 20, built, 0);
        if (!built) continue;
        must(body, peri_add_velocity(body, block, fall));
        must(body, peri_apply_body_force(body, block, gravity, NULL, NULL));
    }
    peri_contact_desc_init(&contact);
    contact.friction = 0.5;
    contact.restitution = 0.6;
    must(body, peri_set_contact(body, PERI_ALL, PERI_ALL, &contact));

    peri_advance_desc_init(&run);
    run.duration = duration;
    run.damping = 4; /* [1/s] */
    run.frame_steps = 20;
    run.on_frame = watch;
    must(body, peri_advance(body, &run));

    must(body, peri_get_energy(body, &e));
    peri_view at;
    must(body, peri_view_field(body, PERI_FIELD_CURRENT_POSITION, &at));
    for (int64_t i = peri_point_count(body) - 600; i < peri_point_count(body); ++i)
        heap = fmax(heap, ((const double *)at.data)[i * at.point_stride + at.component_stride]);
    printf("%ld of %ld bonds broken in %ld steps; the heap is %.2f m high\n", (long)peri_broken_count(body), (long)peri_bond_count(body),
           (long)peri_step_count(body), heap + 4 * h);
    print_energy(body);
    must(body, picture("out/crush.png", body, PERI_FIELD_DAMAGE, "damage", 0, 1, 800, 0));
    must(body, peri_export_vtu(body, "out/crush.vtu"));
    peri_body_destroy(body);
    return 0;
}
