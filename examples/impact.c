/* SPDX-License-Identifier: MIT */
/* impact.c - a hard ball pushes through a glass plate.

   The ball is a rigid obstacle: a point of the plate at depth d inside it is pushed out with the force density k d.
   It keeps its speed, as if it were very heavy. The plate is held at its rim. The work that the ball does on the
   plate goes into motion, strain and cracks. Writes out/impact.png (damage, seen from the far side) and
   out/impact.vtu. */
#include "png.h"

static const double h = 2e-3, radius = 10e-3, speed = 5, duration = 90e-6; /* [m], [m/s], [s] */

/* The centre of the ball at a time. It comes from below and meets the lowest points, which lie h/2 inside the face
   z = 0 of the plate, at t = 0. */
static int32_t ball_place(void *user, double time, double *place) {
    (void)user;
    place[0] = place[1] = 0;
    place[2] = speed * time - radius + h / 2;
    return 0;
}

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
    must(plate, peri_get_obstacle_force(plate, w->ball, force));
    if (force[2] > w->peak) w->peak = force[2], w->time = peri_time(plate);
    progress("impact", plate, duration);
    return 0;
}

int main(void) {
    const double lo[3] = {-50e-3, -50e-3, 0}, hi[3] = {50e-3, 50e-3, 12e-3}; /* 50 x 50 x 6 points */
    double place[3];
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
    (void)ball_place(NULL, 0, place);
    w.ball = must(plate, peri_add_ball_obstacle(plate, place, radius, 0, ball_place, NULL));

    peri_advance_desc_init(&run);
    run.duration = duration;
    run.frame_steps = 2;
    run.on_frame = watch;
    run.user = &w;
    must(plate, peri_advance(plate, &run));

    printf("contact force: at most %.0f N, at %.1f us\n", w.peak, 1e6 * w.time);
    printf("%ld of %ld bonds broken in %ld steps\n", (long)peri_broken_count(plate),
           (long)peri_bond_count(plate), (long)peri_step_count(plate));
    print_energy(plate);
    must(plate, picture_field("out/impact.png", plate, PERI_FIELD_DAMAGE, 0, 1, 800, 1));
    must(plate, peri_export_vtu(plate, "out/impact.vtu"));
    peri_body_destroy(plate);
    return 0;
}
