/* SPDX-License-Identifier: MIT */
/* semicircle.c - a half disc of PMMA with an inclined notch in bending: [T] 5.2, Figs 5.10 to 5.18.

   R 50 mm, 5 mm thick, notch 15 mm at beta to the load, supports 21.5 mm from the middle ([T] has 26, a misprint), E 2.94 GPa, nu 0.38.
   Kinks measured: 0, 23, 62, 83 degrees at beta 0, 10, 30, 50; x at heights of 17, 21.4, 30, 40 mm in the figures. Plane stress, LPS on
   whole families (PERI_MOMENTS_WHOLE), horizon 4 spacings of 1 mm (another as first argument), fracture control: no inertia. Three forces
   in balance act. The slow dynamic runs of tests/test_kinks.c, at 0.5 mm, come nearer to the kinks (docs/accuracy.md). */
#include "gallery.h"

enum { HEIGHTS = 4 };
static const double mm = 1e-3, R = 50e-3, notch = 15e-3, span = 21.5e-3, height[HEIGHTS] = {17, 21.4, 30, 40};

static int32_t inside(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return x[1] >= 0 && hypot(x[0], x[1]) <= R;
}

static int32_t until_top(void *user, peri_body *body) {
    const broken_bonds *bonds = (const broken_bonds *)user;
    (void)body;
    return bonds->count > 0 && bonds->at[3 * (bonds->count - 1) + 1] > 43 * mm;
}

static void bend(FILE *figures, double beta, double h, double m, const double *ways, double kink) {
    const double angle = beta / 57.29577951308232, lo[2] = {-R, 0}, hi[2] = {R, R};
    const double ends[4] = {-h * tan(angle), -h, notch * sin(angle), notch * cos(angle)}, spot[3][2] = {{0, R}, {-span, 0}, {span, 0}};
    broken_bonds bonds = {NULL, NULL, 0, 0};
    char what[96], name[64];
    peri_body_desc desc;
    peri_material_desc pmma;
    peri_solve_desc statics;
    peri_solve_report report;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS, desc.geometry = PERI_GEOMETRY_LINEAR, desc.thickness = 5 * mm, desc.horizon = 1.000001 * m * h;
    desc.moments = PERI_MOMENTS_WHOLE;
    peri_body *disc = must_create(&desc);
    peri_material_desc_init(&pmma, PERI_LAW_LPS);
    pmma.young = 2.94e9, pmma.poisson = 0.38, pmma.density = 1180, pmma.fracture_energy = 500;
    const int32_t material = must(disc, peri_add_material(disc, &pmma));
    must(disc, peri_add_shape(disc, material, lo, hi, h, inside, NULL)), must(disc, peri_build(disc));
    must(disc, peri_cut_segment(disc, PERI_CUT_INITIAL, ends, ends + 2));
    for (int k = 0; k < 3; ++k) { /* 1000 N, down on top and up at the supports; nothing breaks near them */
        const double force[2] = {0, k == 0 ? -1000 : 500};
        const int32_t set = must(disc, peri_select_ball(disc, NULL, spot[k], 2 * mm));
        must(disc, peri_apply_layer_traction(disc, set, 1 / desc.thickness, force, NULL, NULL));
        must(disc, peri_set_no_fail(disc, must(disc, peri_select_ball(disc, NULL, spot[k], 6 * mm)), 1));
    }
    bonds.x = field_of(disc, PERI_FIELD_POSITION);
    must(disc, peri_on_break(disc, note_bond, &bonds));
    peri_solve_desc_init(&statics);
    statics.control = PERI_CONTROL_FRACTURE, statics.loose = PERI_LOOSE_PINNED, statics.load_to = 1e3, statics.tolerance = 1e-6;
    statics.on_step = until_top, statics.user = &bonds;
    must(disc, peri_solve(disc, &statics, &report));
    snprintf(name, sizeof name, "semicircle_%.0f", beta);
    map_of(name, disc, PERI_FIELD_DAMAGE, 0);

    const double found = 90 - beta - direction(&bonds, ends[2], ends[3], m * h, fmax(5 * mm, m * h + 2.5 * mm), 0, 1);
    snprintf(what, sizeof what, "beta %.0f: kink", beta);
    figure(figures, what, remainder(-found, 360), kink, 12, "degrees");
    for (int q = 0; q < HEIGHTS; ++q) {
        double sum = 0, count = 0;
        for (int64_t k = 0; k < bonds.count; ++k)
            if (fabs(bonds.at[3 * k + 1] - height[q] * mm) < 1.2 * h) sum += bonds.at[3 * k] / mm, count += 1;
        snprintf(what, sizeof what, "beta %.0f: x at a height of %g mm", beta, height[q]);
        if (ways) figure(figures, what, sum / count, ways[q], q < 2 ? m * h / mm : 4, "mm");
    }
    printf("    %ld broken, %ld passes\n", (long)report.broken, (long)report.passes);
    free((void *)bonds.x), free(bonds.at);
    peri_body_destroy(disc);
}

int main(int argc, char **argv) {
    static const double straight[HEIGHTS] = {0, 0, 0, 0}, way_30[HEIGHTS] = {4.7, 2.6, 0.7, 0}, way_50[HEIGHTS] = {6, 4.1, 1.6, 0.2};
    const double h = argc > 1 ? atof(argv[1]) * mm : 1 * mm, m = argc > 2 ? atof(argv[2]) : 4;
    FILE *f = figures_of("semicircle");
    bend(f, 0, h, m, straight, 0), bend(f, 10, h, m, NULL, 23), bend(f, 30, h, m, way_30, 62), bend(f, 50, h, m, way_50, 83);
    fclose(f);
    return 0;
}
