/* SPDX-License-Identifier: MIT */
/* test_survivors_levels.c - what `make mutants` found that no other test of the multilevel preconditioner looked at.

   SOURCE OF TRUTH: docs/statics.md: iterations hardly grow with the number of points; and a solve that a preconditioner serves ends at its
   tolerance, whatever the law, the space and the contrast of materials. */
#include "scene.h"

static int32_t side(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e9, -1e9}, hi[3] = {to, 1e9, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* A bar, its right half `ratio` times as stiff, held at the left and along x at the right, pulled all over its right half. */
static int64_t iterations_of(int32_t space, int32_t law, int nx, int ny, double ratio, int32_t preconditioner) {
    const double lo[3] = {0, 0, 0}, hi[3] = {nx / 2, ny, ny}, next[3] = {nx / 2, 0, 0}, far[3] = {nx, ny, ny};
    const double force[3] = {1e-3, 2e-3, 1e-3};
    specimen s = specimen_of(space, law, 0.3, 1, 2.2, 1, 1, 1);
    peri_solve_desc d;
    peri_solve_report r;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_start(&s);
    peri_material_desc m = s.material;
    m.young *= ratio;
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &m)), next, far, 1));
    MUST(b, peri_build(b));
    MUST(b, peri_prescribe_displacement(b, side(b, 0, 2), all_axes(dim_of(space)), NULL, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, side(b, nx - 2, nx), PERI_AXIS_X, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, nx / 2, nx), force, NULL, NULL));
    peri_solve_desc_init(&d);
    d.preconditioner = preconditioner;
    d.tolerance = 1e-7;
    d.iterations = 3000;
    memset(&r, 0, sizeof r);
    MUST(b, peri_solve(b, &d, &r));
    CHECK(r.residual <= 1e-7 && r.iterations > 1);
    peri_body_destroy(b);
    return r.iterations;
}

static void iterations_hardly_grow(void) {
    static const int32_t laws[2] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS};
    int k;
    for (k = 0; k < 2; ++k) {
        const int64_t small = iterations_of(PERI_SPACE_PLANE_STRESS, laws[k], 24, 8, 1, PERI_PRECONDITIONER_MULTILEVEL);
        const int64_t large = iterations_of(PERI_SPACE_PLANE_STRESS, laws[k], 96, 32, 1, PERI_PRECONDITIONER_MULTILEVEL);
        CHECK(3 * large <= 4 * small);
    }
    const int64_t small = iterations_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 12, 4, 1, PERI_PRECONDITIONER_MULTILEVEL);
    const int64_t large = iterations_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 36, 8, 1, PERI_PRECONDITIONER_MULTILEVEL);
    CHECK(3 * large <= 4 * small);
}

static void levels_serve_two_materials(void) {
    const int64_t levels = iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 60, 20, 1e-3, PERI_PRECONDITIONER_MULTILEVEL);
    const int64_t blocks = iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 60, 20, 1e-3, PERI_PRECONDITIONER_BLOCK_JACOBI);
    CHECK(2 * levels < blocks);
    (void)iterations_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 16, 8, 1e5, PERI_PRECONDITIONER_BLOCK_JACOBI);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(iterations_hardly_grow);
    RUN(levels_serve_two_materials);
    return test_end("test_survivors_levels");
}
