/* SPDX-License-Identifier: MIT */
/* own_stress.c - a stress of one's own: J2 plasticity with linear hardening by radial return (Simo, Hughes 1998, box 3.1), small strains,
   and a bar of it that is pulled and pushed, against the closed form.
   cc -O2 examples/own_stress.c peri_impl.c -lm */
#include "example.h"

static const double young = 210e9, poisson = 0.3, yield = 250e6, hardening = 21e9, most = 4e-3; /* [Pa], strain */

/* history: plastic strain [3][3], then its length times sqrt(2/3). */
static int32_t steel(void *user, const peri_stress_block *at) {
    const double mu = young / (2 * (1 + poisson)), bulk = young / (3 * (1 - 2 * poisson)), stiff = 2 * mu + 2.0 / 3 * hardening;
    for (int64_t p = 0; p < at->count; ++p) {
        const double *h = &at->gradient[9 * p], trace = h[0] + h[4] + h[8];
        double *past = &at->history[10 * p], s[9], norm = 0, flow = 0;
        for (int k = 0; k < 9; ++k) {
            s[k] = 2 * mu * (0.5 * (h[k] + h[k % 3 * 3 + k / 3]) - (k % 4 ? 0 : trace / 3) - past[k]);
            norm += s[k] * s[k];
        }
        norm = sqrt(norm);
        flow = fmax(0, norm - sqrt(2.0 / 3) * (yield + hardening * past[9])) / stiff;
        const double turn = flow > 0 ? 1 - 2 * mu * flow / norm : 1;
        const double along = flow > 0 ? 2 * mu * (2 * mu / stiff - 1 + turn) / norm / norm : 0;
        for (int k = 0; at->tangent && k < 81; ++k) {
            const int i = k / 9, j = k % 9, both = i % 4 == 0 && j % 4 == 0, same = (i == j) + (j == i % 3 * 3 + i / 3);
            at->tangent[81 * p + k] = bulk * both + 2 * mu * turn * (0.5 * same - both / 3.0) - along * s[i] * s[j];
        }
        for (int k = 0; k < 9; ++k) {
            at->stress[9 * p + k] = turn * s[k] + (k % 4 ? 0 : bulk * trace);
            past[k] += flow > 0 ? flow * s[k] / norm : 0;
        }
        past[9] += sqrt(2.0 / 3) * flow;
    }
    return user != NULL;
}

static int32_t pull(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    for (int64_t k = 0; k < count; ++k) value[3 * k] = factor * most * ((const double *)user)[3 * points[k]];
    return 0;
}

int main(void) {
    static double x[3 * 192];
    const double lo[3] = {0, 0, 0}, hi[3] = {0.12, 0.04, 0.04}, area = 0.04 * 0.04, soft = young * hardening / (young + hardening);
    double force[3], worst = 0;
    peri_material_desc material;
    peri_body_desc desc;
    peri_body_desc_init(&desc);
    desc.space = PERI_SPACE_SOLID;
    desc.horizon = 0.0151;
    desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *body = must_create(&desc);
    peri_material_desc_init(&material, PERI_LAW_CORRESPONDENCE);
    material.young = young;
    material.poisson = poisson;
    material.density = 7850;
    material.stress = steel;
    material.history = 10;
    (void)must(body, peri_add_box(body, must(body, peri_add_material(body, &material)), lo, hi, 0.01));
    (void)must(body, peri_build(body));
    (void)must(body, peri_get_field(body, PERI_FIELD_POSITION, x, 3 * peri_point_count(body)));
    const double left[3] = {0.02, 0.04, 0.04}, right[3] = {0.1, 0, 0}; /* ends, a horizon deep */
    const int32_t ends[2] = {must(body, peri_select_box(body, NULL, lo, left)), must(body, peri_select_box(body, NULL, right, hi))};
    (void)must(body, peri_prescribe_displacement(body, ends[0], PERI_AXIS_X, NULL, pull, x));
    const int32_t grip = must(body, peri_prescribe_displacement(body, ends[1], PERI_AXIS_X, NULL, pull, x));
    peri_solve_desc solve;
    peri_solve_desc_init(&solve);
    solve.loose = PERI_LOOSE_PINNED; /* across */
    const double first = yield + soft * (most - yield / young), factor[4] = {1, 0.5, 0, -1}; /* yields again at -first */
    for (int k = 0; k < 4; ++k) {
        const double down = first - young * most * (1 - factor[k]), want = down > -first ? down : -first + soft * (down + first) / young;
        solve.load_to = factor[k];
        (void)must(body, peri_solve(body, &solve, NULL));
        (void)must(body, peri_get_reaction(body, grip, force));
        printf("own stress: strain %7.4f, stress %7.2f MPa; closed form %7.2f\n", factor[k] * most, force[0] / area / 1e6, want / 1e6);
        worst = fmax(worst, fabs(force[0] / area - want) / yield);
    }
    peri_body_destroy(body);
    return worst < 0.01 ? EXIT_SUCCESS : EXIT_FAILURE;
}
