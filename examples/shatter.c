/* SPDX-License-Identifier: MIT */
/* shatter.c - a disc flies through three panes of glass that stand on a floor.

   Four bodies of a world, of two spacings, materials and precisions. Pieces touch each other, other bodies and the floor.
   The glass is softened, as in games: steps are longer. Writes out/shatter_0.png to out/shatter_5.png (damage). */
#include "picture.h"

enum { PANES = 3, BODIES = PANES + 1, FRAMES = 5 };
static const double h = 4e-3, scale = 800; /* [m], pixels per metre */

static void draw(peri_body *const *body, int frame) {
    char path[64];
    peri_picture view;
    must(NULL, peri_picture_create(&view, 880, 400, PERI_PICTURE_SEQUENTIAL));
    peri_picture_rectangle(&view, 0, 370, 880, 400, PERI_PICTURE_LIGHT);
    for (int k = 0; k < BODIES; ++k) { /* each point a square */
        const double half = 0.55 * (k == PANES ? 2 : 1) * h * scale;
        const int64_t n = peri_point_count(body[k]);
        static double x[1000], damage[500];
        must(body[k], peri_get_field(body[k], PERI_FIELD_CURRENT_POSITION, x, 2 * n));
        must(body[k], peri_get_field(body[k], PERI_FIELD_DAMAGE, damage, n));
        for (int64_t i = 0; i < n; ++i) {
            const double right = x[2 * i] * scale, down = 370 - x[2 * i + 1] * scale;
            const int colour = k == PANES ? PERI_PICTURE_GREY : peri_picture_shade(damage[i], 0, 1);
            peri_picture_rectangle(&view, right - half, down - half, right + half, down + half, colour);
        }
    }
    (void)snprintf(path, sizeof path, "out/shatter_%d.png", frame);
    must(NULL, peri_picture_write(path, &view));
    peri_picture_destroy(&view);
}

/* A pane with its foot at x, or the disc. Its pieces touch each other and the floor. */
static peri_body *make(int disc, double x, const peri_contact_desc *contact) {
    const double lo[2] = {x, 0}, hi[2] = {x + 4 * h, 90 * h}, centre[2] = {x, 0.2}, velocity[2] = {16, 1};
    const double weight[2] = {0, (disc ? 7850 : 2500) * -9.81};
    peri_body_desc desc;
    peri_material_desc m;
    peri_obstacle_desc floor;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.horizon = disc ? 6.03 * h : 2.515 * h, desc.thickness = 0.01;
    desc.precision = disc ? PERI_PRECISION_DOUBLE : PERI_PRECISION_SINGLE;
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = disc ? 0.6e9 : 0.25e9, m.density = disc ? 7850 : 2500, m.fracture_energy = disc ? 0 : 30;
    const int32_t id = must(body, peri_add_material(body, &m));
    must(body, disc ? peri_add_ball(body, id, centre, 0.06, 2 * h) : peri_add_box(body, id, lo, hi, h));
    must(body, peri_build(body));
    must(body, peri_apply_body_force(body, PERI_ALL, weight, NULL, NULL));
    if (disc) must(body, peri_add_velocity(body, PERI_ALL, velocity));
    peri_obstacle_desc_init(&floor, PERI_SHAPE_PLANE);
    floor.normal[1] = 1, floor.friction = 0.3;
    must(body, peri_add_obstacle(body, &floor));
    must(body, peri_set_contact(body, id, id, contact));
    return body;
}

int main(void) {
    peri_world_desc desc;
    peri_contact_desc contact;
    peri_advance_desc run;
    peri_world *world;
    peri_body *body[BODIES];
    peri_world_desc_init(&desc), peri_contact_desc_init(&contact), peri_advance_desc_init(&run);
    contact.friction = 0.3, contact.restitution = 0.6;
    must(NULL, peri_world_create(&desc, &world, NULL));
    for (int k = 0; k < BODIES; ++k)
        must(NULL, peri_world_add(world, body[k] = make(k == PANES, k == PANES ? 0.12 : 0.3 + 0.2 * k, &contact)));
    must(NULL, peri_world_set_contact(world, NULL, NULL, &contact));
    run.duration = 8e-3;
    for (int frame = 0; frame <= FRAMES; ++frame) {
        if (frame > 0) must(NULL, peri_world_advance(world, &run));
        draw(body, frame);
        printf("%2.0f ms: %ld bonds of the last pane broken\n", 1e3 * peri_time(body[2]), (long)peri_broken_count(body[2]));
    }
    for (int k = 0; k < BODIES; ++k) peri_body_destroy(body[k]);
    peri_world_destroy(world);
    return 0;
}
