/* SPDX-License-Identifier: MIT */
/* A ball of two materials dropped on a moving floor, and a clone of it, as it was written for peri 0.1: points with material numbers, an
   influence function that returns its value, a view, the loads by number, every status that has another name. */
#include "peri.h"
#include <math.h>
#include <stdio.h>

static double weight(void *user, double q) {
    (void)user;
    return q < 1 ? 1 - q : 0;
}

static void floor_at(void *user, double time, double *place) { place[2] = *(const double *)user * time; }

static int32_t upper(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)i;
    (void)j;
    return (xi[2] > 6) != (xj[2] > 6);
}

static int32_t rim(void *user, int64_t index, const double *x) {
    (void)user;
    (void)index;
    return x[0] > 3;
}

int main(void) {
    const double centre[3] = {0, 0, 4}, down[3] = {0, 0, -1e-3}, place[3] = {0, 0, 0}, normal[3] = {0, 0, 1}, gravity[3] = {0, 0, -1e-6};
    const double at[6] = {0, 0, 8.6, 0, 0, 9.6}, volumes[2] = {1, 1};
    const int32_t materials[2] = {1, 1};
    double speed = 1e-4, momentum[3], force[3];
    peri_body_desc d;
    peri_material m;
    peri_run r;
    peri_view view;
    peri_memory memory;
    peri_body *ball, *copy;
    peri_body_desc_init(&d);
    d.space = PERI_SOLID;
    d.precision = PERI_MIXED;
    d.horizon = 2.5;
    d.influence = PERI_INFLUENCE_USER;
    d.influence_fn = weight;
    d.instructions = PERI_BASELINE;
    if (peri_body_create(&d, &ball, NULL) < 0) return 1;
    peri_material_init(&m, PERI_LPS);
    m.bulk = 1;
    m.poisson = 0.2;
    m.density = 1;
    m.model = PERI_LPS;
    peri_add_material(ball, &m);
    m.bulk = 2;
    peri_add_material(ball, &m);
    if (peri_add_ball(ball, 0, centre, 4, 1) < 0 || peri_add_points(ball, 2, at, volumes, materials) < 0) return 1;
    if (peri_build(ball) != PERI_OK) return 1;
    if (peri_select_points(ball, NULL, 0, materials) != PERI_ERROR_SET || peri_find_set(ball, "rim") != PERI_ERROR_SET) return 1;
    if (peri_remove_load(ball, 0) != PERI_ERROR_ID) return 1;
    const int32_t edge = peri_select_if(ball, "rim", rim, NULL);
    if (peri_cut_if(ball, upper, NULL) <= 0 || peri_set_size(ball, edge) <= 0) return 1;
    peri_add_velocity(ball, PERI_ALL, down);
    peri_apply_body_force(ball, PERI_ALL, gravity, NULL, NULL);
    peri_add_plane_obstacle(ball, place, normal, 0, floor_at, &speed);
    peri_run_init(&r);
    r.integrator = PERI_VELOCITY_VERLET;
    r.steps = 50;
    if (peri_clone(ball, &copy, NULL) < 0 || peri_advance(ball, &r) < 0 || peri_advance(copy, &r) < 0) return 1;
    if (peri_view_field(copy, PERI_MATERIAL, &view) < 0 || view.type != PERI_F64) return 1;
    const int first = (int)((const double *)view.data)[0], last = (int)((const double *)view.data)[view.count - 1];
    peri_read_momentum(ball, momentum, NULL);
    peri_read_reaction(ball, 0, force);
    peri_read_memory(ball, &memory);
    printf("materials %d and %d, momentum %.2e, weight %.2e, %d bytes\n", first, last, momentum[2], force[2], (int)memory.total);
    const double points = (double)peri_point_count(ball);
    peri_body_destroy(ball);
    peri_body_destroy(copy);
    return !(first == 0 && last == 1 && momentum[2] < 0 && fabs(force[2] / (-1e-6 * points) - 1) < 0.2);
}
