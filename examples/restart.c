/* SPDX-License-Identifier: MIT */
/* restart.c - a run that saves its state now and then, dies, and goes on in another body: the same bits as the run
   that was not interrupted.
   cc -O2 examples/restart.c peri_impl.c -lm */
#include "example.h"
#include <string.h>

enum { N = 60 * 30, STEPS = 120, PARTS = 4 };

/* The scene is the program's to build: a notched pane whose upper and lower edges are drawn apart. */
static peri_body *pane(void) {
    const double lo[2] = {0, 0}, hi[2] = {0.06, 0.03}, from[2] = {0, 0.015}, to[2] = {0.02, 0.015};
    const double bottom[2] = {0.06, 0.003}, top[2] = {0, 0.027}, up[2] = {0, 3}, down[2] = {0, -3};
    peri_body_desc desc;
    peri_material_desc glass;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 3e-3;
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&glass, PERI_LAW_LPS);
    glass.young = 72e9;
    glass.poisson = 0.22;
    glass.density = 2440;
    glass.fracture_energy = 135;
    (void)must(body, peri_add_box(body, must(body, peri_add_material(body, &glass)), lo, hi, 1e-3));
    (void)must(body, peri_build(body));
    (void)must(body, peri_cut_segment(body, PERI_CUT_INITIAL, from, to));
    (void)must(body, peri_prescribe_velocity(body, must(body, peri_select_box(body, NULL, lo, bottom)), PERI_AXIS_Y, down, NULL, NULL));
    (void)must(body, peri_prescribe_velocity(body, must(body, peri_select_box(body, NULL, top, hi)), PERI_AXIS_Y, up, NULL, NULL));
    return body;
}

static void advance(peri_body *body) {
    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.steps = STEPS;
    (void)must(body, peri_advance(body, &run));
}

int main(void) {
    static double u[2][2 * N];
    peri_body *straight = pane(), *broken_off = pane();
    for (int part = 0; part < PARTS; ++part) advance(straight);

    for (int part = 0; part < 2; ++part) {
        advance(broken_off);
        (void)must(broken_off, peri_save_state(broken_off, part % 2 ? "out/restart_b.state" : "out/restart_a.state"));
    }
    peri_body_destroy(broken_off); /* the machine goes down */

    peri_body *again = pane(); /* another day, another program: the same calls */
    (void)must(again, peri_load_state(again, "out/restart_b.state"));
    printf("taken up at %.2f us, after %ld steps, with %ld bonds broken\n", 1e6 * peri_time(again), (long)peri_step_count(again),
           (long)peri_broken_count(again));
    for (int part = 2; part < PARTS; ++part) advance(again);

    (void)must(straight, peri_get_field(straight, PERI_FIELD_DISPLACEMENT, u[0], 2 * N));
    (void)must(again, peri_get_field(again, PERI_FIELD_DISPLACEMENT, u[1], 2 * N));
    const int same = memcmp(u[0], u[1], sizeof u[0]) == 0 && peri_broken_count(straight) == peri_broken_count(again);
    printf("%ld and %ld bonds broken; displacements %s\n", (long)peri_broken_count(straight), (long)peri_broken_count(again),
           same ? "the same to the last bit" : "DIFFER");
    print_energy(again);
    peri_body_destroy(straight);
    peri_body_destroy(again);
    return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
