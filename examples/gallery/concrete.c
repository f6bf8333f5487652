/* SPDX-License-Identifier: MIT */
/* concrete.c - Nooru-Mohamed: concrete with two notches, sheared first and then pulled apart ([T] 5.2, Figs 5.27 to 5.34).

   200 x 200 x 50 mm, notches 25 mm deep and a row of points high, E 30 GPa, nu 0.2, 110 J/m^2, plane strain, LPS. L-shaped frames hold two
   edges each: a shear force pushes the upper frame from the left and the lower from the right, and stays while they part by 0.15 mm. The
   experiment shows two bowed cracks, each the other turned by half a turn; straight ones without shear. */
#include "gallery.h"

enum { CELLS = 41 };
static const double side = 0.2, h = 0.2 / CELLS, thickness = 0.05;

static int32_t solid(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return !(fabs(x[1] - 0.5 * side) < 0.4 * h && (x[0] < 0.025 || x[0] > side - 0.025));
}

/* The force acts whatever the load factor is. */
static int32_t steady(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    (void)factor, (void)points;
    for (int64_t k = 0; k < count; ++k) value[2 * k] = *(const double *)user;
    return 0;
}

static void shear(FILE *figures, const char *name, double force) {
    const double strip = 3 * h, middle = 0.5 * h + 1e-6, zero[2] = {0, 0}, up[2] = {0, 75e-6}, down[2] = {0, -75e-6};
    const double box[6][4] = {{0, side - strip, side, side}, {0, side / 2 + middle, strip, side}, {0, 0, side, strip},
                              {side - strip, 0, side, side / 2 - middle}, {0, side / 2 + middle, h, side},
                              {side - h, 0, side, side / 2 - middle}};
    const double lo[2] = {0, 0}, hi[2] = {side, side};
    double push[2] = {force / (thickness * side / 2), -force / (thickness * side / 2)}, bow = 0, off = 0;
    int32_t set[6];
    char what[96];
    peri_body_desc desc;
    peri_material_desc concrete;
    peri_solve_desc statics;
    peri_solve_report report;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRAIN, desc.geometry = PERI_GEOMETRY_LINEAR, desc.horizon = 4.01 * h, desc.thickness = thickness;
    peri_body *plate = must_create(&desc);
    peri_material_desc_init(&concrete, PERI_LAW_LPS);
    concrete.young = 30e9, concrete.poisson = 0.2, concrete.density = 2400, concrete.fracture_energy = 110;
    const int32_t material = must(plate, peri_add_material(plate, &concrete));
    must(plate, peri_add_shape(plate, material, lo, hi, h, solid, NULL)), must(plate, peri_build(plate));
    for (int k = 0; k < 6; ++k) set[k] = must(plate, peri_select_box(plate, NULL, box[k], box[k] + 2));
    for (int k = 0; k < 4; ++k) {
        must(plate, peri_set_no_fail(plate, set[k], 1));
        must(plate, peri_prescribe_displacement(plate, set[k], PERI_AXIS_Y, k < 2 ? up : down, NULL, NULL));
    }
    for (int k = 0; k < 2; ++k) must(plate, peri_apply_layer_traction(plate, set[4 + k], side / 2, zero, steady, &push[k]));
    peri_solve_desc_init(&statics);
    statics.loose = PERI_LOOSE_PINNED; /* the slide along x, which the two forces balance */
    statics.steps = 20;
    must(plate, peri_solve(plate, &statics, &report));
    map_of(name, plate, PERI_FIELD_DAMAGE, 0);
    double *x = field_of(plate, PERI_FIELD_POSITION), *damage = field_of(plate, PERI_FIELD_DAMAGE);
    const int64_t n = peri_point_count(plate);
    for (int64_t i = 0; i < n; ++i) {
        if (damage[i] > 0.3) bow = fmax(bow, 1e3 * fabs(x[2 * i + 1] - side / 2));
        off = fmax(off, fabs(damage[i] - damage[n - 1 - i]));
    }
    snprintf(what, sizeof what, "bow at %.0f kN (asked: 25 mm or more)", 1e-3 * force);
    if (force > 7e3) figure(figures, what, bow, fmax(bow, 25), 1e-9, "mm");
    else figure(figures, what, bow, 25, 0, "mm");
    snprintf(what, sizeof what, "damage off its image through the centre at %.0f kN", 1e-3 * force);
    figure(figures, what, off, 0, 1e-6, "");
    free(x), free(damage);
    peri_body_destroy(plate);
}

int main(void) {
    FILE *f = figures_of("concrete");
    shear(f, "concrete_5", 5e3), shear(f, "concrete_10", 10e3);
    fclose(f);
    return 0;
}
