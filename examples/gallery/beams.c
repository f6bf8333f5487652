/* SPDX-License-Identifier: MIT */
/* beams.c - three beams, bond-based, plane stress: [T] 4.1, Figs 4.1 to 4.12.

   30 mm x 1.5 mm, 1 mm thick, E 70 GPa: built in with a force or with a moment at its end, or simply supported under a uniform load. Loads
   act on the last column (or top row) of points, as in the thesis, which compares with finite elements; here Timoshenko's beam is the
   reference, with Poisson's ratio 1/3, the one that bonds have. */
#include "gallery.h"

enum { FORCE, MOMENT, UNIFORM };
static const double length = 30e-3, depth = 1.5e-3, young = 70e9, load = 10; /* [m], [Pa], [N] (moment: N times depth) */

static double theory(int what, double x) {
    const double inertia = depth * depth * depth / 12, ei = young * inertia, shear = young / (2 * (1 + 1.0 / 3)) * depth * 5 / 6;
    if (what == FORCE) return -load * x * x * (3 * length - x) / (6 * ei) - load * x / shear;
    if (what == MOMENT) return -load * depth * x * x / (2 * ei);
    return -load / length * (x * (length * length * length - 2 * length * x * x + x * x * x) / (24 * ei) + x * (length - x) / (2 * shear));
}

/* A uniform moment: forces linear in the depth ([T] Fig. 4.2). */
static int32_t moment_of(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    const double *y = (const double *)user;
    double sum = 0;
    for (int64_t k = 0; k < count; ++k) sum += y[2 * points[k] + 1] * y[2 * points[k] + 1];
    for (int64_t k = 0; k < count; ++k) value[2 * k] *= factor * y[2 * points[k] + 1] / sum, value[2 * k + 1] = 0;
    return 0;
}

/* Largest deflection over that of theory. rows: points across; m: horizon over spacing. With a file: the axis, point by point. */
static double bend(int what, int rows, int m, FILE *file) {
    const double h = depth / rows, horizon = m * h, wall = what == UNIFORM ? 0 : horizon, tip = length - (what == UNIFORM ? 0 : h);
    const double lo[2] = {-wall, -depth / 2}, hi[2] = {length, depth / 2}, held[2] = {0, depth / 2}, last[2] = {tip, -depth / 2};
    const double top[2] = {0, depth / 2 - h}, total[2] = {0, -load}, left[2] = {h, depth}, right[2] = {length - h, -depth};
    const double unit[2] = {load * depth / (h * h), 0}; /* force density per unit of y/sum y^2; moment = sum of y f h^2 */
    peri_body_desc desc;
    peri_material_desc metal;
    peri_solve_desc statics;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.geometry = PERI_GEOMETRY_LINEAR, desc.horizon = horizon;
    peri_body *beam = must_create(&desc);
    peri_material_desc_init(&metal, PERI_LAW_BOND_BASED);
    metal.young = young, metal.density = 2700;
    const int32_t material = must(beam, peri_add_material(beam, &metal));
    must(beam, peri_add_box(beam, material, lo, hi, h)), must(beam, peri_build(beam));
    double *x = field_of(beam, PERI_FIELD_POSITION);
    if (what == UNIFORM) {
        must(beam, peri_apply_layer_traction(beam, must(beam, peri_select_box(beam, NULL, top, hi)), 1, total, NULL, NULL));
        must(beam, peri_prescribe_displacement(beam, must(beam, peri_select_box(beam, NULL, lo, left)), PERI_AXIS_Y, NULL, NULL, NULL));
        const int32_t far = must(beam, peri_select_box(beam, NULL, right, hi)), first = 0;
        must(beam, peri_prescribe_displacement(beam, far, PERI_AXIS_Y, NULL, NULL, NULL));
        must(beam, peri_prescribe_displacement(beam, must(beam, peri_select_points(beam, NULL, 1, &first)), PERI_AXIS_X, NULL, NULL, NULL));
    } else {
        const int32_t end = must(beam, peri_select_box(beam, NULL, last, hi));
        must(beam, peri_prescribe_displacement(beam, must(beam, peri_select_box(beam, NULL, lo, held)), PERI_AXIS_XY, NULL, NULL, NULL));
        if (what == FORCE) must(beam, peri_apply_layer_traction(beam, end, 1, total, NULL, NULL));
        else must(beam, peri_apply_body_force(beam, end, unit, moment_of, x));
    }
    peri_solve_desc_init(&statics);
    must(beam, peri_solve(beam, &statics, NULL));
    double *u = field_of(beam, PERI_FIELD_DISPLACEMENT), most = 0, want = 0;
    for (int64_t i = 0; i < peri_point_count(beam); ++i) {
        const double at = x[2 * i], y = x[2 * i + 1];
        if (y < 0 || y > 0.9 * h || at < 0) continue; /* the row of points on the axis, or next above */
        if (file) fprintf(file, "%d,%g,%.6g,%.6g\n", what, 1e3 * at, 1e3 * u[2 * i + 1], 1e3 * theory(what, at));
        if (fabs(theory(what, at)) > want) want = fabs(theory(what, at)), most = fabs(u[2 * i + 1]);
    }
    free(x), free(u);
    peri_body_destroy(beam);
    return most / want;
}

int main(void) {
    FILE *axis = table("beams", "case,x,found,theory"), *series = table("beams_tip", "series,at,percent"), *f = figures_of("beams");
    figure(f, "force at the end: deflection over theory", bend(FORCE, 20, 3, axis), 1, 0.045, "");
    figure(f, "moment at the end", bend(MOMENT, 20, 3, axis), 1, 0.055, "");
    figure(f, "simply supported, uniform load", bend(UNIFORM, 20, 3, axis), 1, 0.035, "");
    for (int rows = 5; rows <= 20; rows += 5)
        fprintf(series, "spacing,%g,%g\n", 1e3 * depth / rows, 100 * (bend(FORCE, rows, 3, NULL) - 1));
    for (int m = 2; m <= 8; m += 2) fprintf(series, "m,%d,%g\n", m, 100 * (bend(FORCE, 5 * m / 2, m, NULL) - 1));
    fclose(axis), fclose(series), fclose(f);
    return 0;
}
