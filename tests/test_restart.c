/* SPDX-License-Identifier: MIT */
/* A state that was put aside and taken up again goes on as if nothing had been.

   SOURCE OF TRUTH: the run that was not interrupted, to the last bit. */
#include "restart_scene.h"

static const int32_t laws[4] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE };
static const int32_t precisions[3] = { PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE };

/* ---- reading and writing back ------------------------------------------------------------------------------------------------------- */

static void write_back(peri_body *b) {
    static double out[600];
    const int64_t dofs = peri_point_count(b) * peri_dimension(b);
    for (int32_t field = PERI_FIELD_DISPLACEMENT; field <= PERI_FIELD_VELOCITY; ++field) {
        (void)MUST(b, peri_get_field(b, field, out, dofs));
        (void)MUST(b, peri_set_field(b, field, out, dofs));
    }
}

/* Read and written back every few steps, a run stays the same to the last bit: motion, bonds, ledger. */
static void read_then_written_is_as_before(void) {
    for (int law = 0; law < 4; ++law)
        for (int p = 0; p < 3; ++p) {
            const scene s = scene_of(laws[law], law == 1 ? PERI_CRITERION_BOND_ENERGY : PERI_CRITERION_STRETCH, precisions[p], law % 2);
            peri_body *a = scene_make(&s), *b = scene_make(&s);
            for (int part = 0; part < 3; ++part) {
                scene_run(a, 20);
                scene_run(b, 20);
                write_back(b);
            }
            CHECK(peri_broken_count(a) > 10 && same_state(a, b));
            peri_body_destroy(a);
            peri_body_destroy(b);
        }
}

/* One entry that was changed is the only one that changes. */
static void only_what_differs_is_set(void) {
    static double now[600], then[600], velocity[600];
    const scene s = scene_of(PERI_LAW_BOND_BASED, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, 1);
    peri_body *a = scene_make(&s), *b = scene_make(&s);
    const int64_t dofs = peri_point_count(a) * peri_dimension(a);
    peri_view v, w;
    int64_t differ = 0;
    scene_run(a, 20);
    scene_run(b, 20);
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, now, dofs));
    (void)MUST(a, peri_get_field(a, PERI_FIELD_VELOCITY, velocity, dofs));
    now[37] += 0.125;
    (void)MUST(a, peri_set_field(a, PERI_FIELD_DISPLACEMENT, now, dofs));
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, then, dofs));
    CHECK_NEAR(then[37], now[37], 1e-15, 0);
    (void)MUST(a, peri_view_field(a, PERI_FIELD_DISPLACEMENT, &v));
    (void)MUST(b, peri_view_field(b, PERI_FIELD_DISPLACEMENT, &w));
    for (int64_t i = 0; i < v.count; ++i)
        for (int32_t d = 0; d < v.components; ++d) {
            const int64_t at = i * v.point_stride + d * v.component_stride;
            differ += ((const double *)v.data)[at] != ((const double *)w.data)[at];
        }
    CHECK(differ == 1);
    CHECK(same_view(a, b, PERI_FIELD_VELOCITY));
    peri_body_destroy(a);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(read_then_written_is_as_before);
    RUN(only_what_differs_is_set);
    return test_end("test_restart");
}
