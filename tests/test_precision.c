/* SPDX-License-Identifier: MIT */
/* test_precision.c - mixed precision: the state in double, bonds in single. SOURCE OF TRUTH: the same scene in double, conservation of
   momentum and energy, and Hooke's law. What the kernels do is checked in test_kernels.c. */
#include "equilibrium.h"

/* A bar of points, held at one end. */
static peri_body *bar(int32_t law, int32_t precision, int32_t geometry, int64_t length, int cloud, double s0) {
    specimen s = specimen_of(PERI_SPACE_SOLID, law, 0.3, 1, 2.2, (int)length, 5, 5);
    s.desc.precision = precision;
    s.desc.geometry = geometry;
    s.material.critical_stretch = s0;
    s.scatter = cloud ? 0.5 : 0;
    s.seed = 3;
    return specimen_make(&s);
}

/* A slender bar bent by a small force at its end: single precision cannot reach such a residual, because displacements are large beside
   strains; mixed precision reaches its default tolerance, and agrees with double to what that leaves open. */
static void statics_as_in_double(void) {
    const double aside[3] = {0, 1e-7, 0};
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (int32_t way = 0; way < 4; ++way) {
            const int32_t geometry = way & 1 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
            double *u[2];
            int64_t n = 0;
            for (int k = 0; k < 2; ++k) {
                peri_body *b = bar(law, k ? PERI_PRECISION_MIXED : PERI_PRECISION_DOUBLE, geometry, 60, way >> 1, 0);
                peri_solve_desc s = statics_of(0);
                peri_solve_report r;
                MUST(b, peri_prescribe_displacement(b, slab(b, 0, 0, 3), PERI_AXIS_X | PERI_AXIS_Y | PERI_AXIS_Z, NULL, NULL, NULL));
                MUST(b, peri_apply_layer_traction(b, slab(b, 0, 59, 60), 25.0, aside, NULL, NULL));
                r = solve(b, &s);
                CHECK(r.residual <= (k ? 1e-5 : 1e-8));
                u[k] = get(b, PERI_FIELD_DISPLACEMENT);
                n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
                peri_body_destroy(b);
            }
            const double apart = furthest(u[0], u[1], n) / largest(u[0], n);
            printf("    law %d, %s, %s: apart by %.1e of the deflection\n", (int)law % 100, way & 1 ? "linear" : "nonlinear",
                   way >> 1 ? "cloud" : "lattice", apart);
            CHECK(largest(u[0], n) > 1e-6 && apart <= 1e-4);
            free(u[0]);
            free(u[1]);
        }
}

/* A run through fracture: the same bonds break as in double where no criterion is met to within 1e-6, energy and momentum are kept, and the
   state is handed out as double. */
static void fracture_as_in_double(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (int cloud = 0; cloud < 2; ++cloud) {
            double *u[2], *damage[2];
            int64_t n = 0, broken[2];
            for (int k = 0; k < 2; ++k) {
                peri_body *b = bar(law, k ? PERI_PRECISION_MIXED : PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 20, cloud, 0.02);
                const double pull[3] = {0.05, 0, 0}, push[3] = {-0.05, 0, 0};
                double before[3], total[3];
                peri_energy e;
                peri_view view;
                peri_advance_desc run;
                MUST(b, peri_add_velocity(b, slab(b, 0, 10, 20), pull));
                MUST(b, peri_add_velocity(b, slab(b, 0, -1, 9.99), push));
                peri_advance_desc_init(&run);
                run.steps = 60;
                run.safety = 0.3; /* it is the precisions that are compared: where steps err much, a rounding decides on a bond */
                MUST(b, peri_get_momentum(b, before, NULL));
                MUST(b, peri_advance(b, &run));
                broken[k] = peri_broken_count(b);
                MUST(b, peri_get_energy(b, &e));
                MUST(b, peri_get_momentum(b, total, NULL));
                /* double leaves open what its step does; the derivative of the energy is rounded to 6e-8 in each of 60 steps beside */
                CHECK(law != PERI_LAW_BOND_BASED || fabs(e.error) < 2e-3 * e.initial);
                for (int d = 0; d < 3; ++d) {
                    CHECK(fabs(total[d] - before[d]) < 25 * 4e-13); /* 500 spacings cubed at 0.05 */
                }
                MUST(b, peri_view_field(b, PERI_FIELD_DISPLACEMENT, &view));
                CHECK(view.type == PERI_TYPE_F64);
                n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
                u[k] = get(b, PERI_FIELD_DISPLACEMENT);
                damage[k] = get(b, PERI_FIELD_DAMAGE);
                peri_body_destroy(b);
            }
            CHECK(broken[0] > 50 && broken[0] == broken[1]);
            CHECK(memcmp(damage[0], damage[1], (size_t)(n / 3) * sizeof(double)) == 0);
            CHECK(furthest(u[0], u[1], n) <= 1e-5 * largest(u[0], n));
            for (int k = 0; k < 2; ++k) {
                free(u[k]);
                free(damage[k]);
            }
        }
}

/* A bar stretched by 1e-9, and then carried 1e4 spacings away: the stress is Hooke's, there as here, to 7 digits. */
static void far_and_small(void) {
    for (int cloud = 0; cloud < 2; ++cloud) {
        const double away[3] = {1e4, 3e4, -2e4};
        peri_body *b = bar(PERI_LAW_CORRESPONDENCE, PERI_PRECISION_MIXED, PERI_GEOMETRY_NONLINEAR, 12, cloud, 0);
        const int64_t n = peri_size_of_field(b, PERI_FIELD_POSITION);
        double *x = get(b, PERI_FIELD_POSITION), *stress[2];
        for (int64_t i = 0; i < n; ++i) x[i] *= i % 3 == 0 ? 1e-3 : -0.3e-3;
        MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, x, n));
        stress[0] = get(b, PERI_FIELD_STRESS);
        MUST(b, peri_add_displacement(b, PERI_ALL, away));
        stress[1] = get(b, PERI_FIELD_STRESS);
        for (int64_t i = 0; i < n / 3; ++i) {
            CHECK_NEAR(stress[0][6 * i], 1e-3, 3e-3, 0); /* Saint Venant-Kirchhoff: of second order in the strain apart */
            for (int k = 0; k < 6; ++k) CHECK_NEAR(stress[1][6 * i + k], stress[0][6 * i + k], 0, 1e-3 * 2e-6);
        }
        free(x);
        free(stress[0]);
        free(stress[1]);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(statics_as_in_double);
    RUN(fracture_as_in_double);
    RUN(far_and_small);
    return test_end("test_precision");
}
