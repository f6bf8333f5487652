/* SPDX-License-Identifier: MIT */
/* test_precision.c - mixed precision: the state in double, bonds in single; and what single precision cannot hold. SOURCE OF TRUTH: the
   same scene in double, conservation of momentum and energy, Hooke's law, and the rounding of IEEE 754. What the kernels do is checked in
   test_kernels.c, the balance of forces in test_momentum.c. */
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
            /* lattices in one geometry, clouds in the other; all with --long */
            if (!test_long && (way + way / 2 + law) % 2) continue;
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

/* ---- single precision --------------------------------------------------------------------------------------------- */

/* Four points, each of a spacing: two at the ends of the diagonal of a square or cube, and a pair at `at` and at + xi; all in each other's
   family. loader: a search, the reference kernel, families of the caller. */
static peri_body *pair_within(double extent, int dim, int32_t precision, int loader, const double *at, const double *xi, int32_t law) {
    static const int32_t families[4 * 4] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
    static const double volumes[4] = {1, 1, 1, 1};
    specimen s = specimen_of(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, law, 0.2, 1, 2 * extent, 1, 1, 1);
    double x[4 * 3];
    s.desc.precision = precision;
    if (loader == 1) s.desc.kernel = PERI_KERNEL_REFERENCE;
    peri_body *b = specimen_start(&s);
    for (int d = 0; d < dim; ++d) {
        x[d] = 0;
        x[dim + d] = extent;
        x[2 * dim + d] = at[d];
        x[3 * dim + d] = at[d] + xi[d];
    }
    MUST(b, peri_add_points(b, 4, x, volumes, NULL));
    if (loader == 2) MUST(b, peri_set_families(b, 4, families));
    return b;
}

/* Is the bond off by more than a tenth of its length where the places of its ends are rounded to single precision? */
static int is_lost(int dim, const double *at, const double *xi) {
    double off = 0, square = 0;
    for (int d = 0; d < dim; ++d) {
        const double end = at[d] + xi[d];
        off += pow((double)(float)end - (double)(float)at[d] - (end - at[d]), 2);
        square += pow(end - at[d], 2);
    }
    return off > 0.01 * square;
}

/* What is lost in single precision is refused, and no other bond: some of those shorter than 2.1e-6 of the extent, most below 2e-7. */
static void lost_bonds_are_refused(void) {
    uint64_t seed = 11;
    int64_t lost = 0, kept = 0;
    for (int way = 0; way < 12 * 100; ++way) {
        const int dim = 2 + way % 2, loader = way / 2 % 3, turned = way < 12;
        const double extent = way / 6 % 2 ? 16384 : 1;
        double length = extent * (turned ? 5 * ULP32 : pow(10, -8 + 3.5 * test_random(&seed))), at[3], xi[3], size = 0;
        for (int d = 0; d < dim; ++d) {
            at[d] = extent * (0.5 + 0.49 * test_random(&seed));
            xi[d] = test_random(&seed) - 0.5;
            size += xi[d] * xi[d];
        }
        for (int d = 0; d < dim; ++d) xi[d] *= length / sqrt(size);
        for (int d = 0; turned && d < dim; ++d) { /* 3.4 and 3.67 units of rounding become 3 and 4: no longer and no shorter */
            at[d] = 0.75 * extent;
            xi[d] = extent * ULP32 * (d == 0 ? 3.4 : d == 1 ? sqrt(25 - 3.4 * 3.4) : 0);
        }
        const int want = is_lost(dim, at, xi);
        CHECK(!turned || want);
        CHECK(!want || length < 2.1e-6 * extent);
        lost += want;
        kept += !want;
        for (int32_t precision = PERI_PRECISION_DOUBLE; precision < peri__end_precision; ++precision) {
            peri_body *b = pair_within(extent, dim, precision, loader, at, xi, PERI_LAW_BOND_BASED + way / 12 % 4);
            const int32_t status = peri_build(b);
            peri_error error;
            if (precision != PERI_PRECISION_SINGLE || !want) CHECK(status == PERI_OK);
            else {
                MUST(b, peri_get_error(b, &error));
                CHECK(status == PERI_ERROR_COINCIDENT && strcmp(error.field, "precision") == 0 && error.index == 2);
            }
            peri_body_destroy(b);
        }
    }
    CHECK(lost > 100 && kept > 100);
}

/* Two lattices far apart, by columns: whatever asks for the places of points finds the far one as the near one, to the rounding of the
   places; or it is refused, where a bond there is off by a tenth. */
static void far_lattices_are_refused_or_right(void) {
    static const double away[7] = {1e4, 1e5 + 0.3371, 1e6 + 0.25, 4e6 + 0.3371, 1.7e7, 1e8 + 0.3, 1e12};
    int refused = 0;
    for (int way = 0; way < 7 * 4 * 3; ++way) {
        const int32_t precision = PERI_PRECISION_DOUBLE + way / 28;
        const double far_ = away[way % 7], lo[2] = {far_, 0}, hi[2] = {far_ + 8, 6};
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED + way / 7 % 4, 0.2, 1, 2.2, 8, 6, 1);
        double u[2 * 96] = {0}, error = 0, rounding = 0;
        s.desc.precision = precision;
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
        for (int k = 0; k < 8; ++k)
            for (int j = 0; j < k && k - j < 3; ++j) {
                const double end = far_ + k + 0.5, begin = far_ + j + 0.5;
                rounding = fmax(rounding, fabs((double)((float)end - (float)begin) - (end - begin)) / (k - j));
            }
        if (precision == PERI_PRECISION_SINGLE && rounding > 0.1) {
            CHECK(peri_build(b) == PERI_ERROR_COINCIDENT);
            refused++;
        } else {
            MUST(b, peri_build(b));
            CHECK(strncmp(peri_kernel_text(b), "columns", 7) == 0);
            for (int i = 0; i < 96; ++i) u[2 * i] = 0.01 * (i % 8);
            put(b, PERI_FIELD_DISPLACEMENT, u);
            double *stress = get(b, PERI_FIELD_STRESS), *f = get(b, PERI_FIELD_FORCE_DENSITY);
            for (int i = 0; i < 3 * 48; ++i) error = fmax(error, fabs(stress[3 * 48 + i] - stress[i]));
            for (int i = 0; i < 2 * 48; ++i) error = fmax(error, fabs(f[2 * 48 + i] - f[i]));
            CHECK(error <= 0.01 * (precision == PERI_PRECISION_SINGLE ? 3 * rounding + 1e-4 : 1e-6));
            free(stress);
            free(f);
        }
        peri_body_destroy(b);
    }
    CHECK(refused == 3 * 4);
}

/* Bonds so short that squares of their squares are beyond single precision, but not lost in it: stretched by 1 % their force is that of
   double precision. */
static void short_bonds_pull_as_in_double(void) {
    static const double lengths[5] = {3e-4, 1e-6, 1e-8, 1e-9, 1e-11};
    for (int way = 0; way < 5 * 3 * 2 * 2; ++way) {
        const int loader = way / 5 % 3, dim = 2 + way / 15 % 2;
        const int32_t law = way / 30 ? PERI_LAW_LPS : PERI_LAW_BOND_BASED;
        const double at[3] = {0.2 * lengths[way % 5], 0, 0}, xi[3] = {0.8 * lengths[way % 5], 0.6 * lengths[way % 5], 0};
        double *f[3];
        for (int k = 0; k < 3; ++k) {
            double u[4 * 3] = {0};
            peri_body *b = pair_within(1, dim, PERI_PRECISION_DOUBLE + k, loader, at, xi, law);
            MUST(b, peri_build(b));
            for (int d = 0; d < dim; ++d) u[3 * dim + d] = 0.01 * xi[d];
            put(b, PERI_FIELD_DISPLACEMENT, u);
            f[k] = get(b, PERI_FIELD_FORCE_DENSITY);
            peri_body_destroy(b);
        }
        for (int k = 1; k < 3; ++k)
            for (int d = 0; d < dim; ++d) CHECK_NEAR(f[k][2 * dim + d], f[0][2 * dim + d], 1e-4, 1e-4 * fabs(f[0][2 * dim]));
        CHECK(f[0][2 * dim] > 0);
        for (int k = 0; k < 3; ++k) free(f[k]);
    }
}

/* Bonds whose length the rounding of places changes by 1 to 8 % keep it: of the extension that is half, of the stretch no more. In mixed
   precision nothing is lost. */
static void blurred_bonds_keep_their_length(void) {
    for (int way = 0; way < 3 * 2 * 8; ++way) {
        const int loader = way % 3, dim = 2 + way / 3 % 2;
        const double extent = 16384, unit = extent * ULP32, at[3] = {0.75 * extent, 0, 0}, xi[3] = {(5.4 + 3 * (way / 6)) * unit, 0, 0};
        const double off = 0.4 * unit / xi[0];
        double f[3];
        for (int k = 0; k < 3; ++k) {
            double u[4 * 3] = {0};
            peri_body *b = pair_within(extent, dim, PERI_PRECISION_DOUBLE + k, loader, at, xi, PERI_LAW_BOND_BASED);
            MUST(b, peri_build(b));
            u[3 * dim] = 0.01 * xi[0];
            put(b, PERI_FIELD_DISPLACEMENT, u);
            double *force = get(b, PERI_FIELD_FORCE_DENSITY);
            f[k] = force[2 * dim];
            free(force);
            peri_body_destroy(b);
        }
        CHECK_NEAR(f[1], f[0], 1e-5, 0);
        CHECK_NEAR(f[2], f[0], 0.55 * off, 0);
    }
}

/* A support that holds still holds still: the place that it prescribes is none of single precision's, and what is left over must not be
   made good again and again. Velocities there are 0 and it does no work, in any precision. */
static void held_points_do_not_drift(void) {
    for (int32_t precision = PERI_PRECISION_DOUBLE; precision < peri__end_precision; ++precision) {
        const double there[3] = {0.1, -0.037, 0};
        peri_body *b = bar(PERI_LAW_BOND_BASED, precision, PERI_GEOMETRY_NONLINEAR, 8, 1, 0);
        const int32_t held = slab(b, 0, 0, 2);
        peri_energy energy[2];
        MUST(b, peri_prescribe_displacement(b, held, PERI_AXIS_XYZ, there, NULL, NULL));
        go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 20, 0, 0);
        for (int k = 0; k < 2; ++k) {
            double *v = get(b, PERI_FIELD_VELOCITY), *x = get(b, PERI_FIELD_POSITION);
            for (int64_t i = 0; i < peri_point_count(b); ++i)
                if (x[3 * i] < 1.9) CHECK(v[3 * i] == 0 && v[3 * i + 1] == 0 && v[3 * i + 2] == 0);
            MUST(b, peri_get_energy(b, &energy[k]));
            free(v);
            free(x);
            go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 200, 0, 0);
        }
        CHECK(energy[0].external > 1e-3);
        CHECK(energy[1].external == energy[0].external);
        peri_body_destroy(b);
    }
}

/* Displacements in single precision are rounded to 6e-8 of themselves, in every step anew. So a body that is D spacings from where it was
   built warms up: by less than 0.4 E (6e-8 D)^2 times its volume per step, what springs of E store where ends are off by that. The
   energy that is left over beside a body which stays, each beside the same in double: law by law, lattice and cloud. */
static void bodies_far_from_home_warm_up_as_told(void) {
    for (int way = 0; way < 4 * 2; ++way) {
        double error[2][2];
        for (int p = 0; p < 2; ++p)
            for (int far_ = 0; far_ < 2; ++far_) {
                const double away[3] = {far_ * 4000, far_ * -3000, 0}, drift[3] = {0.03, 0.02, 0};
                specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED + way % 4, 0.2, 1, 2.6, 14, 10, 1);
                peri_energy e;
                s.desc.precision = p ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
                s.scatter = way / 4 ? 0.9 : 0;
                peri_body *b = specimen_make(&s);
                double *v = random_field(2 * 140, 0.02, 6);
                MUST(b, peri_add_displacement(b, PERI_ALL, away));
                put(b, PERI_FIELD_VELOCITY, v);
                MUST(b, peri_add_velocity(b, PERI_ALL, drift));
                go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1000, 0.5 * peri_stable_step(b), 0);
                MUST(b, peri_get_energy(b, &e));
                error[p][far_] = e.error;
                free(v);
                peri_body_destroy(b);
            }
        const double gain = -(error[1][1] - error[0][1]), home = error[1][0] - error[0][0], told = 140 * 1000 * pow(ULP32 * 4000, 2);
        printf("    law %d, %s: %.2f of E (6e-8 D)^2 V per step, at home %.0e\n", way % 4 + 1, way / 4 ? "cloud" : "lattice", gain / told,
               home / told);
        CHECK(gain < 0.4 * told);
        CHECK(fabs(home) < 0.02 * told);
    }
}

/* Two halves of a plate torn apart, for 100,000 steps: thousands of spacings apart, they have warmed up as told, over the way. */
static void halves_torn_apart_warm_up_as_told(void) {
    double error[2], told = 0;
    for (int p = 0; p < 2; ++p) {
        const double pull[3] = {0.06, 0.01, 0};
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 1, 2.6, 20, 12, 1);
        peri_energy e;
        s.desc.precision = p ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        s.material.critical_stretch = 0.03;
        peri_body *b = specimen_make(&s);
        MUST(b, peri_add_velocity(b, slab(b, 0, -1, 10), pull));
        for (int k = 0; k < 50; ++k) {
            go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2000, 0, 0);
            double *u = get(b, PERI_FIELD_DISPLACEMENT);
            for (int i = 0; p && i < 240; ++i) told += 2000 * pow(ULP32 * u[2 * i], 2);
            free(u);
        }
        MUST(b, peri_get_energy(b, &e));
        error[p] = e.error / e.initial;
        told /= p ? e.initial : 1;
        peri_body_destroy(b);
    }
    printf("    left over of the energy: %.2f %% in double, %.2f %% in single precision, %.2f of E (6e-8 D)^2 V per step\n", 100 * error[0],
           100 * error[1], (error[0] - error[1]) / told);
    CHECK(fabs(error[1] - error[0]) < 0.4 * told);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(statics_as_in_double);
    RUN(fracture_as_in_double);
    RUN(far_and_small);
    RUN(lost_bonds_are_refused);
    RUN(far_lattices_are_refused_or_right);
    RUN(short_bonds_pull_as_in_double);
    RUN(blurred_bonds_keep_their_length);
    RUN(held_points_do_not_drift);
    RUN(bodies_far_from_home_warm_up_as_told);
    LONG_RUN(halves_torn_apart_warm_up_as_told);
    return test_end("test_precision");
}
