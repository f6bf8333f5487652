/* SPDX-License-Identifier: MIT */
/* test_limits.c - state-based bodies at the limits of their numbers: no bond left, families that barely hold, weights near the ends of
   single precision, steps that become too large. Each case states its source of truth. */
#include "peri_test.h"

static peri_body *body_of(const peri_body_desc *desc, int32_t law, double nu, double stretch) {
    peri_material_desc m;
    peri_body *b = NULL;
    CHECK(peri_body_create(desc, &b, NULL) == PERI_OK);
    peri_material_desc_init(&m, law);
    m.young = m.density = 1;
    if (law != PERI_LAW_BOND_BASED) m.poisson = nu;
    m.critical_stretch = stretch;
    MUST(b, peri_add_material(b, &m));
    return b;
}

static peri_body *box_of(const peri_body_desc *desc, int32_t law, double nu, double stretch, double side) {
    const double lo[3] = {0, 0, 0}, hi[3] = {side, side, side};
    peri_body *b = body_of(desc, law, nu, stretch);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    MUST(b, peri_build(b));
    return b;
}

/* Displacement = strain * x along x. */
static void pull(peri_body *b, double strain) {
    int64_t n = peri_size_of_field(b, PERI_FIELD_POSITION), i;
    int dim = peri_dimension(b);
    double *x = (double *)malloc((size_t)n * sizeof *x);
    MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, n));
    for (i = 0; i < n; ++i) x[i] = i % dim == 0 ? strain * x[i] : 0;
    MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, x, n));
    free(x);
}

/* Sum of the sizes of all force densities: under uniform strain, that of the surfaces. */
static double forces_of(peri_body *b) {
    int64_t n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY), i;
    double *f = (double *)malloc((size_t)n * sizeof *f), sum = 0;
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, n));
    for (i = 0; i < n; ++i) sum += fabs(f[i]);
    free(f);
    return sum;
}

/* SOURCE OF TRUTH: Newton's first law. A body that has lost every bond flies on, for the time asked. */
static void without_bonds(void) {
    static const int32_t pair[2] = {0, 1};
    const double x[4] = {0, 0, 1, 0}, v[2] = {1, 1}, speed[2] = {0.01, -0.02};
    double u[4];
    int32_t law;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        peri_body_desc desc;
        peri_advance_desc run;
        peri_body *b;
        peri_body_desc_init(&desc);
        desc.space = PERI_SPACE_PLANE_STRAIN;
        desc.horizon = 2;
        b = body_of(&desc, law, 0.3, 0);
        MUST(b, peri_add_points(b, 2, x, v, NULL));
        MUST(b, peri_build(b));
        CHECK(MUST(b, peri_cut_pairs(b, PERI_CUT_INITIAL, 1, pair)) == 1);
        MUST(b, peri_add_velocity(b, PERI_ALL, speed));
        peri_advance_desc_init(&run);
        run.duration = 5;
        MUST(b, peri_advance(b, &run));
        CHECK(peri_time(b) == 5);
        MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 4));
        CHECK_NEAR(u[0], 0.05, 1e-12, 0);
        CHECK_NEAR(u[3], -0.1, 1e-12, 0);
        peri_body_destroy(b);
    }
}

/* SOURCE OF TRUTH: elastic energy of a stable solid is never negative. Random points, random cuts, random displacements; Oterkus's
   constants, taken as printed, make it negative for families of odd shape at low Poisson ratios. */
static void energy_is_never_negative(void) {
    int32_t space, law;
    int cloud, trial, k;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_LPS; law < peri__end_law; ++law)
            for (cloud = 0; cloud < 40; ++cloud) {
                int dim = space == PERI_SPACE_SOLID ? 3 : 2;
                uint64_t seed = (uint64_t)(1000 * cloud + space % 100);
                double x[48], v[16], u[48], density[16];
                peri_body_desc desc;
                peri_body *b;
                peri_body_desc_init(&desc);
                desc.space = space;
                desc.horizon = 2.5;
                desc.geometry = PERI_GEOMETRY_LINEAR;
                desc.influence = PERI_INFLUENCE_LINEAR;
                b = body_of(&desc, law, cloud % 2 ? 0.1 : -0.3, 0);
                for (k = 0; k < 48; ++k) x[k] = (dim == 3 ? 3 : 4) * test_random(&seed);
                for (k = 0; k < 16; ++k) v[k] = 0.5 + test_random(&seed);
                MUST(b, peri_add_points(b, 16, x, v, NULL));
                if (peri_build(b) == PERI_OK)
                    for (trial = 0; trial < 200; ++trial) {
                        for (k = 0; k < 16 * dim; ++k) u[k] = test_random(&seed) - 0.5;
                        MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 16 * dim));
                        MUST(b, peri_get_field(b, PERI_FIELD_ENERGY_DENSITY, density, 16));
                        for (k = 0; k < 16; ++k) CHECK(density[k] >= -1e-12);
                    }
                peri_body_destroy(b);
            }
}

static int32_t scaled(void *user, double q, double *w) {
    *w = *(const double *)user * (1 - 0.5 * q);
    return 0;
}

/* SOURCE OF TRUTH: constant factors of the influence function cancel in every law (peri.h). */
static void factors_of_w_cancel(void) {
    static const double factors[5] = {1, 1e-15, 1e-22, 1e15, 1e20};
    int32_t law, precision, correction;
    int k;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; precision += 2)
            for (correction = PERI_CORRECTION_NONE; correction < peri__end_correction; ++correction) {
                double first = 0;
                for (k = 0; k < 5; ++k) {
                    double factor = factors[k], now;
                    peri_body_desc desc;
                    peri_body *b;
                    peri_body_desc_init(&desc);
                    desc.space = PERI_SPACE_PLANE_STRAIN;
                    desc.horizon = 3;
                    desc.precision = precision;
                    desc.correction = correction;
                    desc.influence = PERI_INFLUENCE_USER;
                    desc.influence_fn = scaled;
                    desc.influence_user = &factor;
                    b = box_of(&desc, law, 0.45, 0, 12);
                    pull(b, 0.01);
                    now = forces_of(b);
                    if (k == 0) first = now;
                    CHECK(first > 0);
                    CHECK_NEAR(now, first, precision == PERI_PRECISION_DOUBLE ? 1e-10 : 1e-4, 0);
                    peri_body_destroy(b);
                }
            }
}

/* SOURCE OF TRUTH: the textbook kernel in double precision. At 1.0001 s0 along x the bonds that lie along x are beyond s0 and no others,
   however small s0 is. */
static void small_critical_stretch(void) {
    int32_t law, precision, reference;
    for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        int64_t want = 0;
        for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; precision += 2)
            for (reference = 1; reference >= 0; --reference) {
                peri_body_desc desc;
                peri_advance_desc run;
                peri_body *b;
                peri_body_desc_init(&desc);
                desc.space = PERI_SPACE_SOLID;
                desc.horizon = 2.1;
                desc.precision = precision;
                desc.kernel = reference ? PERI_KERNEL_REFERENCE : PERI_KERNEL_BEST;
                b = box_of(&desc, law, 0.2, 1e-4, 8);
                pull(b, 1.0001e-4);
                peri_advance_desc_init(&run);
                run.steps = 1;
                run.time_step = 1e-9;
                MUST(b, peri_advance(b, &run));
                if (precision == PERI_PRECISION_DOUBLE && reference) want = peri_broken_count(b);
                CHECK(want == 7 * 64 + 6 * 64 && peri_broken_count(b) == want);
                peri_body_destroy(b);
            }
    }
}

/* Leaves the nearest neighbours only: the modulus of whole families on four bonds each. */
static int32_t far_apart(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)i;
    (void)j;
    return hypot(xi[0] - xj[0], xi[1] - xj[1]) > 1.1;
}

static int32_t cut_far(void *user, peri_body *b) {
    if (peri_step_count(b) == 2) *(int64_t *)user = peri_cut_if(b, PERI_CUT_NOW, far_apart, NULL);
    return 0;
}

/* SOURCE OF TRUTH: peri.h. A step that was not given is shortened, forced or not; one that is still to come and small enough is made. */
static void steps_that_become_too_large(void) {
    int k;
    for (k = 0; k < 3; ++k) {
        int64_t cut = 0;
        double before;
        peri_body_desc desc;
        peri_advance_desc run;
        peri_energy e;
        peri_body *b;
        peri_body_desc_init(&desc);
        desc.space = PERI_SPACE_PLANE_STRESS;
        desc.horizon = 3;
        b = box_of(&desc, PERI_LAW_LPS, 0.3, 0, 10);
        pull(b, 1e-3);
        before = peri_stable_step(b);
        peri_advance_desc_init(&run);
        run.on_frame = cut_far;
        run.user = &cut;
        run.frame_steps = 2;
        run.safety = 1;
        run.steps = k < 2 ? 500 : 0;
        run.force_step = k == 1;
        if (k == 2) {
            run.time_step = 0.7 * before; /* more than is stable after the cut; half of it, of the two last steps, is less */
            run.duration = 2.01 * run.time_step;
        }
        MUST(b, peri_advance(b, &run));
        MUST(b, peri_get_energy(b, &e));
        CHECK(cut > 500 && peri_stable_step(b) < 0.6 * before);
        CHECK(e.kinetic < 1e-3 && peri_step_count(b) == (k < 2 ? 500 : 3));
        if (k == 2) CHECK(peri_time(b) == run.duration);
        peri_body_destroy(b);
    }
}

/* SOURCE OF TRUTH: peri.h: index is the first offending point. Of those that are too fast in one step, whichever component and block of
   points they are in. */
static void first_of_the_fast(void) {
    static const int32_t point[4] = {130, 70, 12, 5};
    static const int32_t axes[4] = {PERI_AXIS_X, PERI_AXIS_Y, PERI_AXIS_X, PERI_AXIS_Y};
    const double fast[2] = {1.1e9, 1.1e9};
    int k, count;
    for (count = 1; count <= 4; ++count) {
        peri_body_desc desc;
        peri_advance_desc run;
        peri_error e;
        peri_body *b;
        peri_body_desc_init(&desc);
        desc.space = PERI_SPACE_PLANE_STRESS;
        desc.horizon = 2;
        desc.geometry = PERI_GEOMETRY_LINEAR;
        b = box_of(&desc, PERI_LAW_BOND_BASED, 0, 0, 12);
        for (k = 0; k < count; ++k)
            MUST(b, peri_prescribe_velocity(b, peri_select_points(b, NULL, 1, &point[k]), axes[k], fast, NULL, NULL));
        peri_advance_desc_init(&run);
        run.steps = 1;
        run.time_step = 1e-3; /* too short to throw the neighbours */
        CHECK(peri_advance(b, &run) == PERI_ERROR_UNSTABLE && peri_get_error(b, &e) == PERI_OK);
        CHECK(e.index == point[count - 1]);
        peri_body_destroy(b);
    }
}

static int32_t near_only(void *user, double q, double *w) {
    (void)user;
    *w = q < 0.6 ? 1 : 0;
    return 0;
}

/* The same of points without a weight, in a cloud whose points come in no order: six on either side of a square, at the height of
   every other row and a spacing and a half from it, two from each other, where w is 0. */
static void first_without_a_weight(void) {
    enum { N = 156 };
    int trial;
    for (trial = 0; trial < 6; ++trial) {
        double x[2 * N], v[N];
        int32_t order[N], k, least = N;
        uint64_t seed = (uint64_t)trial;
        peri_body_desc desc;
        peri_error e;
        peri_body *b;
        for (k = 0; k < N; ++k) order[k] = k;
        for (k = N - 1; k > 0; --k) {
            const int32_t other = (int32_t)(test_random(&seed) * (k + 1)), kept = order[k];
            order[k] = order[other];
            order[other] = kept;
        }
        for (k = 0; k < N; ++k) {
            const int32_t at = order[k], lone = k - 144;
            v[at] = 1;
            x[2 * at] = lone < 0 ? k % 12 + 0.5 : lone < 6 ? -1 : 13;
            x[2 * at + 1] = lone < 0 ? k / 12 + 0.5 : 2 * (lone % 6) + 0.5;
            if (lone >= 0 && at < least) least = at;
        }
        peri_body_desc_init(&desc);
        desc.space = PERI_SPACE_PLANE_STRESS;
        desc.horizon = 2;
        desc.influence = PERI_INFLUENCE_USER;
        desc.influence_fn = near_only;
        b = body_of(&desc, PERI_LAW_LPS, 0.3, 0);
        MUST(b, peri_add_points(b, N, x, v, NULL));
        CHECK(peri_build(b) == PERI_ERROR_FAMILY && peri_get_error(b, &e) == PERI_OK);
        CHECK(e.index == least);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(without_bonds);
    RUN(energy_is_never_negative);
    RUN(factors_of_w_cancel);
    RUN(small_critical_stretch);
    RUN(steps_that_become_too_large);
    RUN(first_of_the_fast);
    RUN(first_without_a_weight);
    return test_end("test_limits");
}
