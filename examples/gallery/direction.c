/* SPDX-License-Identifier: MIT */
/* direction.c - the direction in which a crack sets out depends on Poisson's ratio ([T] 5.2, Figs 5.6 to 5.9).

   A square plate, notched to its middle, is pulled and sheared alike: the largest principal stress of the plate without its notch opens a
   crack at psi = 1/2 arctan(1/(1+nu)). Plane stress, LPS, s0 = 0.1 %. The thesis gives neither size nor horizon nor rate: here the side is
   1 m, the horizon a sixteenth of it for nu 0.1 and a twentieth for 0.4, and the edges part so slowly that waves do not matter. psi is for
   a tip that the plate does not feel: with a shorter horizon the notch's own mixed mode turns the crack by up to 8 degrees more. */
#include "gallery.h"

/* Angle of the first 0.15 m of the crack below the line of the notch. */
static double set_out(const char *name, double nu, int cells, int m) {
    const double h = 1.0 / cells, zone = m * h, speed = 5e-5, lo[2] = {-0.5, -0.5}, hi[2] = {0.5, 0.5}, notch[4] = {-0.5, 0, 0, 0};
    const double top[2] = {-0.5, 0.5 - zone}, low[2] = {0.5, zone - 0.5};
    const double up[2] = {speed / 2, speed / 2}, down[2] = {-speed / 2, -speed / 2};
    const double top_2[2] = {-0.5, 0.5 - 2 * zone}, low_2[2] = {0.5, 2 * zone - 0.5};
    broken_bonds bonds = {NULL, NULL, 0, 0};
    int64_t first = 0;
    double reach = 0, sum[5] = {0, 0, 0, 0, 0};
    peri_body_desc desc;
    peri_material_desc solid;
    peri_advance_desc run;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.horizon = zone;
    peri_body *plate = must_create(&desc);
    peri_material_desc_init(&solid, PERI_LAW_LPS);
    solid.young = solid.density = 1, solid.poisson = nu, solid.critical_stretch = 1e-3; /* speeds in those of sound */
    const int32_t material = must(plate, peri_add_material(plate, &solid));
    must(plate, peri_add_box(plate, material, lo, hi, h)), must(plate, peri_build(plate));
    must(plate, peri_cut_segment(plate, PERI_CUT_INITIAL, notch, notch + 2));
    const int32_t above = must(plate, peri_select_box(plate, NULL, top, hi)), below = must(plate, peri_select_box(plate, NULL, lo, low));
    must(plate, peri_prescribe_velocity(plate, above, PERI_AXIS_XY, up, NULL, NULL));
    must(plate, peri_prescribe_velocity(plate, below, PERI_AXIS_XY, down, NULL, NULL));
    must(plate, peri_set_no_fail(plate, must(plate, peri_select_box(plate, NULL, top_2, hi)), 1));
    must(plate, peri_set_no_fail(plate, must(plate, peri_select_box(plate, NULL, lo, low_2)), 1));
    double *x = field_of(plate, PERI_FIELD_POSITION), *v = field_of(plate, PERI_FIELD_VELOCITY);
    const int64_t n = peri_point_count(plate);
    for (int64_t i = 0; i < 2 * n; ++i) v[i] = speed * x[i - i % 2 + 1]; /* all of the plate parts evenly: no shock */
    must(plate, peri_set_field(plate, PERI_FIELD_VELOCITY, v, 2 * n));
    bonds.x = x;
    must(plate, peri_on_break(plate, note_bond, &bonds));
    peri_advance_desc_init(&run);
    run.steps = 20;
    for (int64_t k = 0; reach < 0.3 && peri_time(plate) < 25;) {
        must(plate, peri_advance(plate, &run));
        for (; k < bonds.count; ++k) reach = fmax(reach, bonds.at[3 * k]);
        if (first == 0 && reach > 0.15) first = bonds.count; /* later ones do not tell how it set out */
    }
    for (int64_t k = 0; k < first; ++k) {
        const double bx = bonds.at[3 * k], by = bonds.at[3 * k + 1], term[5] = {1, bx, by, bx * bx, bx * by};
        if (bx < 0.5 * zone || bx > 0.15 - 0.5 * zone) continue; /* off the tip and the front */
        for (int t = 0; t < 5; ++t) sum[t] += term[t];
    }
    map_of(name, plate, PERI_FIELD_DAMAGE, 0);
    free(x), free(v), free(bonds.at);
    peri_body_destroy(plate);
    return atan((sum[1] * sum[2] / sum[0] - sum[4]) / (sum[3] - sum[1] * sum[1] / sum[0])) * 57.29577951308232;
}

int main(void) {
    const double ratio[2] = {0.1, 0.4};
    const int m[3] = {3, 5, 7};
    FILE *f = figures_of("direction");
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 3; ++j) {
            const double psi = 0.5 * atan(1 / (1 + ratio[k])) * 57.29577951308232;
            char what[64], name[64];
            snprintf(what, sizeof what, "nu %.1f; m = %d", ratio[k], m[j]);
            snprintf(name, sizeof name, "direction_%d_%d", k, m[j]);
            figure(f, what, set_out(name, ratio[k], (k ? 20 : 16) * m[j], m[j]), psi, j == 2 ? 3 : 0, "degrees");
        }
    fclose(f);
    return 0;
}
