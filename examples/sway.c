/* SPDX-License-Identifier: MIT */
/* sway.c - a steel strip is bent, let go, and swings: implicit steps, far longer than explicit ones could be.

   Euler and Bernoulli: the lowest frequency of a clamped strip is 1.8751^2/(2 pi L^2) sqrt(E I/(rho A)) = 0.1615 h/L^2 sqrt(E/rho). */
#include "example.h"

int main(void) {
    const double length = 0.4, height = 0.04, h = height / 10, young = 210e9, density = 7850; /* [m], [Pa], [kg/m^3]        */
    const double lo[2] = {-2.5 * h, 0}, hi[2] = {length, height}, clamp[2] = {0.1 * h, height}, end[2] = {length - 1.1 * h, 0};
    const double push[2] = {0, 2e6}; /* [N/m^3] on the last columns of points                                              */
    const double expected = length * length / (0.1615 * height * sqrt(young / density)); /* [s]                            */
    peri_body_desc desc;
    peri_material_desc steel;
    peri_advance_desc steps;
    peri_solve_desc statics;
    peri_solve_report report;
    double before = 1, first = 0, second = 0, passes = 0;

    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_PLANE_STRESS;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    desc.influence = PERI_INFLUENCE_POWER_3;
    desc.horizon = 3 * h;
    desc.threads = 1;
    peri_body *strip = must_create(&desc);
    peri_material_desc_init(&steel, PERI_LAW_CORRESPONDENCE);
    steel.young = young;
    steel.poisson = 0.3;
    steel.density = density;
    steel.stabilization = 0.4;
    must(strip, peri_add_box(strip, (int32_t)must(strip, peri_add_material(strip, &steel)), lo, hi, h));
    must(strip, peri_build(strip));
    const int32_t held = (int32_t)must(strip, peri_select_box(strip, "held", lo, clamp));
    const int32_t tip = (int32_t)must(strip, peri_select_box(strip, "tip", end, hi));
    must(strip, peri_prescribe_displacement(strip, held, PERI_AXIS_XY, NULL, NULL, NULL));

    peri_solve_desc_init(&statics);
    const int32_t load = (int32_t)must(strip, peri_apply_body_force(strip, tip, push, NULL, NULL));
    must(strip, peri_solve(strip, &statics, NULL));
    must(strip, peri_remove_load(strip, load));

    /* Two steps of the tip through its place at rest, downwards, are a period apart. */
    peri_advance_desc_init(&steps);
    steps.time_step = expected / 40;
    steps.steps = 1;
    const double explicit_passes = steps.time_step / (0.9 * peri_stable_step(strip));
    const int64_t points = peri_point_count(strip);
    double *u = (double *)malloc((size_t)points * 2 * sizeof *u);
    for (int k = 0; k < 140 && u && second == 0; ++k) {
        must(strip, peri_advance_implicit(strip, &steps, NULL, 1.0, &report));
        must(strip, peri_get_field(strip, PERI_FIELD_DISPLACEMENT, u, 2 * points));
        const double now = u[2 * points - 1], part = now / (now - before);
        passes += (double)report.passes;
        if (k > 0 && before > 0 && now <= 0) *(first == 0 ? &first : &second) = peri_time(strip) - part * steps.time_step;
        before = now;
    }
    free(u);
    printf("period: %.4f ms, of the theory of beams %.4f ms\n", 1e3 * (second - first), 1e3 * expected);
    printf("a step is as long as %.0f explicit ones, and costs %.1f force passes\n", explicit_passes, passes / (second / steps.time_step));
    peri_body_destroy(strip);
    return fabs(second - first - expected) > 0.05 * expected;
}
