/* SPDX-License-Identifier: MIT */
/* own_loop.c - a time loop of one's own around the forces and the fracture of the library: a notched pane, torn apart by velocity
   Verlet, and the same by peri_advance.
   cc -O2 examples/own_loop.c peri_impl.c -lm */
#include "example.h"
#include <string.h>

enum { NX = 60, NY = 24, N = NX * NY, STEPS = 300 };
static double x[N][2], u[N][2], v[N][2], force[N][2], impulse[N][2], rho[N], other[N][2];

static peri_body *pane(void) {
    const double lo[2] = {0, 0}, hi[2] = {0.06, 0.024}, from[2] = {0, 0.012}, to[2] = {0.02, 0.012};
    peri_body_desc desc;
    peri_material_desc glass;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.horizon = 3e-3;
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&glass, PERI_LAW_BOND_BASED);
    glass.young = 72e9;
    glass.density = 2440;
    glass.fracture_energy = 135;
    (void)must(body, peri_add_box(body, must(body, peri_add_material(body, &glass)), lo, hi, 1e-3));
    (void)must(body, peri_build(body));
    (void)must(body, peri_cut_segment(body, PERI_CUT_INITIAL, from, to));
    return body;
}

int main(void) {
    peri_body *mine = pane(), *theirs = pane();
    const double dt = 0.8 * peri_stable_step(mine);
    double apart = 0, most = 0;
    int64_t broken = 0;
    (void)must(mine, peri_get_field(mine, PERI_FIELD_POSITION, x[0], 2 * N));
    (void)must(mine, peri_get_field(mine, PERI_FIELD_DENSITY, rho, N));
    for (int i = 0; i < N; ++i) v[i][1] = 700 * (x[i][1] - 0.012); /* [m/s]: both halves fly apart */
    (void)must(theirs, peri_set_field(theirs, PERI_FIELD_VELOCITY, v[0], 2 * N));

    peri_evaluate_desc at;
    peri_evaluate_report report;
    peri_evaluate_desc_init(&at);
    at.displacement = u;
    at.velocity = v;
    at.force = force;
    at.impulse = impulse; /* what bonds that break within a step still gave */
    at.fracture = 1;
    at.time_step = dt;
    for (int step = 0; step < STEPS; ++step) {
        for (int i = 0; i < N; ++i)
            for (int d = 0; d < 2; ++d) {
                v[i][d] += 0.5 * dt / rho[i] * force[i][d]; /* no force at first: the pane is at rest in itself */
                u[i][d] += dt * v[i][d];
            }
        at.time = (step + 1) * dt;
        (void)must(mine, peri_evaluate(mine, &at, &report));
        broken += report.broken;
        for (int i = 0; i < N; ++i)
            for (int d = 0; d < 2; ++d) v[i][d] += (impulse[i][d] + 0.5 * dt * force[i][d]) / rho[i];
    }

    peri_advance_desc run;
    peri_advance_desc_init(&run);
    run.steps = STEPS;
    run.time_step = dt;
    (void)must(theirs, peri_advance(theirs, &run));
    (void)must(theirs, peri_get_field(theirs, PERI_FIELD_DISPLACEMENT, other[0], 2 * N));
    for (int i = 0; i < N; ++i)
        for (int d = 0; d < 2; ++d) apart = fmax(apart, fabs(other[i][d] - u[i][d])), most = fmax(most, fabs(u[i][d]));
    printf("own loop: %ld bonds broken, peri_advance: %ld; displacements of %.1f um differ by %.1e um\n", (long)broken,
           (long)peri_broken_count(theirs), 1e6 * most, 1e6 * apart);
    const int same = broken == peri_broken_count(theirs) && broken > 0 && apart < 1e-9 * most;
    peri_body_destroy(mine);
    peri_body_destroy(theirs);
    return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
