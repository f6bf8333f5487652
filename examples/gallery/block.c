/* SPDX-License-Identifier: MIT */
/* block.c - a square under constant strain by the laws of [C] without corrections: [C] 5, Fig. 7.

   10 mm x 10 mm, plane strain, E 1000 GPa, nu 0, supports and loads on the outermost points as [C] 34 has them, cubic influence function,
   100 x 100 points. Printed: displacement of the middle of the loaded edge over that of the solid. In [C] either law of dilatation is right
   for one problem and far off for the others; with constants that give each family its energy both are within 5 % of all three, and what
   is left comes of families that the faces cut off. The deformation gradient (F) is right for all, but oscillates. */
#include "gallery.h"

enum { UNIAXIAL, ISOTROPIC, SHEAR, N = 100 };
static const double side = 10e-3, young = 1e12, pull = 1e6;

static int32_t edge(peri_body *b, double x0, double y0, double x1, double y1) {
    const double lo[2] = {x0, y0}, hi[2] = {x1, y1};
    return must(b, peri_select_box(b, NULL, lo, hi));
}

static double load(FILE *file, const char *name, int32_t law, double ratio, int problem) {
    const double h = side / N, lo[2] = {0, 0}, hi[2] = {side, side}, along[2] = {problem == SHEAR ? pull : 0, problem == SHEAR ? 0 : pull};
    const double out[2] = {pull, 0}, mu = young / 2, most = problem == ISOTROPIC ? pull / (2 * mu) * side : /* nu 0: lambda 0 */
                                                    problem == SHEAR ? pull / mu * side : pull / (2 * mu) * side;
    peri_body_desc desc;
    peri_material_desc solid;
    peri_solve_desc statics;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRAIN, desc.geometry = PERI_GEOMETRY_LINEAR, desc.horizon = ratio * h;
    desc.influence = PERI_INFLUENCE_POWER_3;
    peri_body *b = must_create(&desc);
    peri_material_desc_init(&solid, law);
    solid.young = young, solid.poisson = 0, solid.density = 7800, solid.stabilization = 0;
    const int32_t material = must(b, peri_add_material(b, &solid));
    must(b, peri_add_box(b, material, lo, hi, h)), must(b, peri_build(b));
    const int32_t bottom = edge(b, 0, 0, side, h), top = edge(b, 0, side - h, side, side);
    const int32_t left = edge(b, 0, 0, h, side), right = edge(b, side - h, 0, side, side);
    if (problem == ISOTROPIC) {
        must(b, peri_prescribe_displacement(b, left, PERI_AXIS_X, NULL, NULL, NULL));
        must(b, peri_prescribe_displacement(b, bottom, PERI_AXIS_Y, NULL, NULL, NULL));
        must(b, peri_apply_layer_traction(b, right, side, out, NULL, NULL));
    } else {
        const int32_t axis = problem == SHEAR ? PERI_AXIS_Y : PERI_AXIS_X;
        must(b, peri_prescribe_displacement(b, left, axis, NULL, NULL, NULL));
        must(b, peri_prescribe_displacement(b, right, axis, NULL, NULL, NULL));
        must(b, peri_prescribe_displacement(b, bottom, PERI_AXIS_XY, NULL, NULL, NULL));
    }
    must(b, peri_apply_layer_traction(b, top, side, along, NULL, NULL));
    peri_solve_desc_init(&statics);
    statics.tolerance = 1e-6;
    must(b, peri_solve(b, &statics, NULL));
    double *x = field_of(b, PERI_FIELD_POSITION), *u = field_of(b, PERI_FIELD_DISPLACEMENT), mean = 0;
    for (int i = 0; i < N; ++i) {
        const int at = i * N + N / 2, last = (N - 1) * N + 2 * N / 5 + i / 5;
        fprintf(file, "%d,%s,%g,%.6g,%.6g\n", problem, name, 1e3 * x[2 * at + 1], u[2 * at + (problem != SHEAR)] / most,
                u[2 * at + (problem == SHEAR)] / most);
        mean += u[2 * last + (problem != SHEAR)] / most / N;
    }
    free(x), free(u);
    peri_body_destroy(b);
    return mean;
}

int main(void) {
    static const char *const problem_name[3] = {"uniaxial", "isotropic", "shear"}, *const law_name[4] =
        {"Silling 3.5", "Oterkus 3.5", "F 1.5", "F 2.5"};
    const int32_t law[4] = {PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE, PERI_LAW_CORRESPONDENCE};
    const double ratio[4] = {3.5, 3.5, 1.5, 2.5};
    FILE *file = table("block", "problem,law,y,along,across"), *f = figures_of("block");
    for (int problem = 0; problem < 3; ++problem)
        for (int k = 0; k < 4; ++k) {
            char what[64];
            snprintf(what, sizeof what, "%s; %s", problem_name[problem], law_name[k]);
            figure(f, what, load(file, law_name[k], law[k], ratio[k], problem), 1, 0.05, "");
        }
    fclose(file), fclose(f);
    return 0;
}
