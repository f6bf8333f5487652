/* SPDX-License-Identifier: MIT */
/* impact.c - a steel ball hits a glass plate and slows down in it.

   The ball is a free rigid body with friction: a point of the plate at depth d inside it is pushed out with the force
   density k d, and the ball by the opposite. The plate is held at its rim. What the ball loses in motion goes into the
   plate: motion, strain, cracks. Writes out/impact.png (damage, seen from the far side) and out/impact.vtu. */
#include "picture.h"

static const double h = 2e-3, radius = 10e-3, speed = 20, duration = 90e-6; /* [m], [m/s], [s] */

static int32_t on_rim(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return fabs(x[0]) > 48e-3 || fabs(x[1]) > 48e-3;
}

typedef struct watcher {
    int32_t ball;
    double  peak, time; /* largest force [N] and when [s] */
} watcher;

static int32_t watch(void *user, peri_body *plate) {
    watcher *w = (watcher *)user;
    double force[3];
    must(plate, peri_get_obstacle_force(plate, w->ball, force, NULL));
    if (force[2] > w->peak) w->peak = force[2], w->time = peri_time(plate);
    progress("impact", plate, duration);
    return 0;
}

int main(void) {
    const double lo[3] = {-50e-3, -50e-3, 0}, hi[3] = {50e-3, 50e-3, 12e-3}; /* 50 x 50 x 6 points */
    watcher w = {0, 0, 0};
    peri_body_desc desc;
    peri_material_desc glass;
    peri_advance_desc run;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_SOLID;
    desc.horizon = 3 * h;
    peri_body *plate = must_create(&desc);
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 72e9;          /* [Pa] */
    glass.density = 2440;        /* [kg/m^3] */
    glass.fracture_energy = 135; /* [J/m^2]; for glass, values from 3.8 to 135 are in use */
    const int32_t material = must(plate, peri_add_material(plate, &glass));
    must(plate, peri_add_box(plate, material, lo, hi, h));
    must(plate, peri_build(plate));
    const int32_t rim = must(plate, peri_select_if(plate, "rim", on_rim, NULL));
    must(plate, peri_prescribe_velocity(plate, rim, PERI_AXIS_XYZ, NULL, NULL, NULL));

    peri_obstacle_desc steel;
    peri_obstacle_state before, after;
    peri_obstacle_desc_init(&steel, PERI_SHAPE_BALL);
    steel.radius = radius;
    steel.place[2] = h / 2 - radius; /* touches the lowest points, which lie h/2 inside the face z = 0 of the plate */
    steel.velocity[2] = speed;
    steel.density = 7850;
    steel.friction = 0.2;
    w.ball = must(plate, peri_add_obstacle(plate, &steel));
    must(plate, peri_get_obstacle_state(plate, w.ball, &before));

    peri_advance_desc_init(&run);
    run.duration = duration;
    run.frame_steps = 2;
    run.on_frame = watch, run.user = &w;
    must(plate, peri_advance(plate, &run));

    must(plate, peri_get_obstacle_state(plate, w.ball, &after));
    printf("the ball, %.0f g: %.2f m/s before, %.2f m/s after, %.3f J less\n", 1e3 * before.mass, before.velocity[2],
           after.velocity[2], before.kinetic - after.kinetic);
    printf("contact force: at most %.0f N, at %.1f us\n", w.peak, 1e6 * w.time);
    printf("%ld of %ld bonds broken in %ld steps\n", (long)peri_broken_count(plate),
           (long)peri_bond_count(plate), (long)peri_step_count(plate));
    print_energy(plate);
    must(plate, picture("out/impact.png", plate, PERI_FIELD_DAMAGE, "damage", 0, 1, 800, 1));
    must(plate, peri_export_vtu(plate, "out/impact.vtu"));
    peri_body_destroy(plate);
    return 0;
}
