/* SPDX-License-Identifier: MIT */
/* test_probes.c - fields at some points, at any places, and the deformation gradient.

   SOURCE OF TRUTH: peri_get_field at these points, to the bit; a linear field is what it is at any place, up to the surface; under an
   affine motion F is that of every bond, whatever the families; the mean that [C] 49 takes with the linear influence function; a field does
   not reach across a cut. */
#include "pool.h"
#include "refusal.h"
#include "scene.h"
#include "specimen.h"

static const double gradient[9] = {0.02, 0.011, -0.004, -0.007, -0.013, 0.006, 0.003, 0.005, 0.009};

/* u = H x + shift, with some of it at random where noise > 0. */
static void deform(peri_body *b, double noise) {
    const int dim = peri_dimension(b);
    const int64_t n = peri_point_count(b);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT);
    uint64_t state = 3;
    for (int64_t i = 0; i < n; ++i)
        for (int a = 0; a < dim; ++a) {
            u[i * dim + a] = 0.03 * (a + 1) + noise * (test_random(&state) - 0.5);
            for (int c = 0; c < dim; ++c) u[i * dim + a] += gradient[3 * a + c] * x[i * dim + c];
        }
    put(b, PERI_FIELD_DISPLACEMENT, u);
    put(b, PERI_FIELD_VELOCITY, u);
    free(x);
    free(u);
}

static specimen cells_of(int32_t space, int32_t law, int32_t precision, double scatter) {
    const int cells = space == PERI_SPACE_SOLID ? 6 : 12;
    specimen s = specimen_of(space, law, 0.2, 0.1, 2.5, cells, cells, cells);
    s.desc.precision = precision;
    s.scatter = scatter;
    s.seed = 5;
    s.material.young = 3;
    return s;
}

/* Every field, of some points given in any order and twice. */
static void subset_is_the_field(void) {
    const int32_t points[6] = {7, 3, 100, 3, 0, 143};
    for (int k = 0; k < 6; ++k) {
        const int32_t law = PERI_LAW_LPS + (k % 3 ? k % 3 - 1 : 2);
        specimen s = cells_of(k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, law, PERI_PRECISION_DOUBLE + k % 3, 0);
        s.material.critical_stretch = 0.05;
        if (k == 1) {
            s.material.law = PERI_LAW_LPS;
            s.material.yield_shear = 1e-3;
        }
        peri_body *b = specimen_make(&s);
        chance some = {5, 0.1};
        MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_chance, &some));
        MUST(b, peri_prescribe_velocity(b, (int32_t)MUST(b, peri_select_points(b, NULL, 2, points)), PERI_AXIS_X, NULL, NULL, NULL));
        deform(b, 2e-3);
        if (k > 2) (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 1e-3, 0);
        for (int32_t field = peri__first_field; field < peri__end_field; ++field) {
            const int64_t parts = MUST(b, peri_size_of_field(b, field)) / peri_point_count(b);
            double out[6 * 9 + 1];
            chance more = {(uint64_t)field, 0.03};
            if (k < 3) MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_chance, &more)); /* what is made of bonds is old then */
            out[6 * parts] = -77;
            MUST(b, peri_get_field_at(b, field, 6, points, out, 6 * parts));
            double *whole = get(b, field);
            for (int64_t n = 0; n < 6 * parts; ++n) {
                const double want = whole[points[n / parts] * parts + n % parts];
                CHECK(memcmp(&out[n], &want, sizeof want) == 0);
            }
            CHECK(out[6 * parts] == -77);
            free(whole);
        }
        peri_body_destroy(b);
    }
}

/* 1 + H at every point under an affine motion: lattices and clouds, corners too, small and finite, with a third of the bonds cut. 1e-12:
   rounding of u of 0.05 over xi of 0.1. In single precision u has 7 digits. */
static void gradient_is_that_of_affine_motion(void) {
    for (int k = 0; k < 16; ++k) {
        static const int32_t law[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};
        const int32_t precision = k < 10 ? PERI_PRECISION_DOUBLE : k < 13 ? PERI_PRECISION_MIXED : PERI_PRECISION_SINGLE;
        specimen s = cells_of(k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, law[k % 4], precision, k / 4 % 2 ? 0.7 : 0);
        if (k % 3) s.desc.geometry = PERI_GEOMETRY_LINEAR;
        if (k == 6) s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
        peri_body *b = specimen_make(&s);
        const int dim = peri_dimension(b);
        chance some = {9, 0.3};
        if (k % 2) MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_chance, &some));
        deform(b, 0);
        double *f = get(b, PERI_FIELD_DEFORMATION_GRADIENT), off = 0;
        CHECK(peri_size_of_field(b, PERI_FIELD_DEFORMATION_GRADIENT) == dim * dim * peri_point_count(b));
        for (int64_t i = 0; i < peri_point_count(b); ++i)
            for (int n = 0; n < dim * dim; ++n)
                off = fmax(off, fabs(f[i * dim * dim + n] - gradient[n / dim * 3 + n % dim] - (n / dim == n % dim)));
        CHECK(off < (precision == PERI_PRECISION_DOUBLE ? 1e-12 : precision == PERI_PRECISION_MIXED ? 1e-6 : 2e-5));
        free(f);
        peri_body_destroy(b);
    }
}

/* A point without bonds is not deformed; of a row of points only what lies along it is. */
static void gradient_of_thin_families(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 0.1, 2.5, 8, 8, 0);
    peri_body *b = specimen_make(&s);
    const double a[2] = {0.1, -1}, z[2] = {0.1, 2};
    MUST(b, peri_cut_segment(b, PERI_CUT_NOW, a, z)); /* the first column */
    deform(b, 0);
    double *f = get(b, PERI_FIELD_DEFORMATION_GRADIENT);
    for (int k = 0; k < 8; ++k) {
        const double want[4] = {1, gradient[1], 0, 1 + gradient[4]};
        for (int n = 0; n < 4; ++n) CHECK_NEAR(f[k * 8 * 4 + n], want[n], 0, 1e-12);
    }
    free(f);
    peri_body_destroy(b);
}

/* ---- places ------------------------------------------------------------------------------------------------------- */

#define PLACES 40

/* In the block, its corners and sides first. */
static void choose_places(const specimen *s, int dim, double *places) {
    uint64_t state = 21;
    for (int k = 0; k < PLACES; ++k)
        for (int d = 0; d < dim; ++d) {
            const double share = k < 8 ? k >> d & 1 : k < 16 ? (d == k % dim ? k & 1 : test_random(&state)) : test_random(&state);
            places[k * dim + d] = share * s->hi[d];
        }
}

/* Position and displacement are linear in the place, the strain of them is constant; in place, too: x = F^-1 (y - shift). */
static void linear_fields_are_exact(void) {
    for (int k = 0; k < 12; ++k) {
        const int32_t precision = PERI_PRECISION_DOUBLE + k % 3, in_place = k / 6;
        const int32_t space = k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
        specimen s = cells_of(space, PERI_LAW_BOND_BASED + k % 4, precision, k / 3 % 2 ? 0.5 : 0);
        if (s.material.law == PERI_LAW_BOND_BASED) s.material.poisson = NAN;
        peri_body *b = specimen_make(&s);
        const int dim = peri_dimension(b);
        double places[PLACES * 3], now[PLACES * 3], x[PLACES * 3], u[PLACES * 3], f[PLACES * 9];
        const double bound = precision == PERI_PRECISION_DOUBLE ? 1e-13 : 1e-6;
        deform(b, 0);
        choose_places(&s, dim, places);
        for (int n = 0; n < PLACES * dim; ++n) {
            const int a = n % dim;
            now[n] = places[n];
            for (int c = 0; in_place && c < dim; ++c) now[n] += gradient[3 * a + c] * places[n - a + c];
            if (in_place) now[n] += 0.03 * (a + 1);
        }
        MUST(b, peri_interpolate_field(b, PERI_FIELD_POSITION, in_place, PLACES, now, x, PLACES * dim));
        MUST(b, peri_interpolate_field(b, PERI_FIELD_VELOCITY, in_place, PLACES, now, u, PLACES * dim));
        MUST(b, peri_interpolate_field(b, PERI_FIELD_DEFORMATION_GRADIENT, in_place, PLACES, now, f, PLACES * dim * dim));
        for (int n = 0; n < PLACES * dim; ++n) {
            double want = 0.03 * (n % dim + 1);
            for (int c = 0; c < dim; ++c) want += gradient[3 * (n % dim) + c] * places[n - n % dim + c];
            CHECK_NEAR(x[n], places[n], 0, bound);
            CHECK_NEAR(u[n], want, 0, bound);
        }
        for (int n = 0; n < PLACES * dim * dim; ++n) {
            const int a = n / dim % dim, c = n % dim;
            CHECK_NEAR(f[n], gradient[3 * a + c] + (a == c), 0, precision == PERI_PRECISION_DOUBLE ? 1e-11 : 2e-5);
        }
        peri_body_destroy(b);
    }
}

/* At points of a lattice whose ball is whole it is [C] 49: sum (1 - r/horizon) u/sum (1 - r/horizon). */
static void smoothing_of_the_convergence_study(void) {
    specimen s = cells_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_CORRESPONDENCE, PERI_PRECISION_DOUBLE, 0);
    peri_body *b = specimen_make(&s);
    const int64_t n = peri_point_count(b);
    int whole = 0;
    deform(b, 0.01);
    double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT), *smooth = get(b, PERI_FIELD_DISPLACEMENT);
    MUST(b, peri_interpolate_field(b, PERI_FIELD_DISPLACEMENT, 0, n, x, smooth, 2 * n));
    for (int64_t i = 0; i < n; ++i) {
        double sum[3] = {0, 0, 0};
        if (fmin(x[2 * i], x[2 * i + 1]) < 0.25 || fmax(x[2 * i], x[2 * i + 1]) > 0.95) continue;
        for (int64_t j = 0; j < n; ++j) {
            const double w = fmax(1 - hypot(x[2 * j] - x[2 * i], x[2 * j + 1] - x[2 * i + 1]) / 0.25, 0);
            sum[0] += w * u[2 * j];
            sum[1] += w * u[2 * j + 1];
            sum[2] += w;
        }
        for (int d = 0; d < 2; ++d) CHECK_NEAR(smooth[2 * i + d], sum[d] / sum[2], 0, 1e-13);
        CHECK(fabs(smooth[2 * i] - u[2 * i]) > 1e-7);
        whole++;
    }
    CHECK(whole == 49 || whole == 64);
    free(x);
    free(u);
    free(smooth);
    peri_body_destroy(b);
}

/* Four neighbours about a point, of other volumes in x than in y: their mean by volume and distance. */
static void cells_count_by_volume(void) {
    const double at[10] = {0, 0, 1, 0, -1, 0, 0, 1, 0, -1}, volume[5] = {0.5, 1, 1, 2, 2}, place[2] = {0, 0};
    const double u[10] = {1, 0, 3, 0, 5, 0, -2, 0, 7, 0}, near_part = 1 - 1 / 1.2;
    double out[2];
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 1.2, 1, 1, 0);
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, 5, at, volume, NULL));
    MUST(b, peri_build(b));
    put(b, PERI_FIELD_DISPLACEMENT, u);
    MUST(b, peri_interpolate_field(b, PERI_FIELD_DISPLACEMENT, 0, 1, place, out, 2));
    CHECK_NEAR(out[0], (0.5 * 1 + near_part * (3 + 5 + 2 * (-2 + 7))) / (0.5 + near_part * 6), 1e-13, 0);
    peri_body_destroy(b);
}

/* Of many places at once each has the bits that it has by itself, where each point is looked at: in and about bodies of any shape, torn
   apart, and of cells of many sizes. */
static void many_places_are_as_one(void) {
    enum { MANY = 60 };
    for (int k = 0; k < 8; ++k) {
        const int32_t space = k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
        specimen s = cells_of(space, PERI_LAW_LPS, PERI_PRECISION_DOUBLE + k % 3, k / 2 % 2 ? 0.8 : 0);
        const int dim = k % 2 ? 3 : 2, in_place = k > 3;
        const double away[3] = {k == 6 ? 1e6 : 3.3, 0.7, 0}, lo[3] = {-1, 0.3, -1}, hi[3] = {2, 9, 9};
        const double lone[6] = {2.05, 0.3, 0.3, 2.5, 0.3, 0.3}, flat[4] = {2.05, 0.3, 2.5, 0.3}, wide[2] = {0.16, 0.16};
        double places[MANY * 3], many[MANY * 3], one[3];
        uint64_t state = (uint64_t)k;
        int outside = 0;
        s.desc.horizon = 0.5;
        s.spacing = 0.125;
        for (int d = 0; d < 3; ++d) s.hi[d] = (dim == 2 ? 12 : 6) * s.spacing;
        peri_body *b = specimen_start(&s);
        const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
        if (s.scatter > 0) MUST(b, peri_add_perturbed_box(b, material, s.lo, s.hi, s.spacing, s.scatter, 5));
        else MUST(b, peri_add_box(b, material, s.lo, s.hi, s.spacing));
        MUST(b, peri_add_points(b, 2, dim == 2 ? flat : lone, wide, NULL));
        MUST(b, peri_build(b));
        deform(b, 0.02);
        MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), away));
        for (int n = 0; n < MANY * dim; ++n) {
            const double share = test_random(&state), wide_share = n < 40 * dim ? 1.6 * share - 0.3 : 3 * share;
            places[n] = n < 20 * dim ? 0.125 * (int)(8 * s.hi[0] * share) : s.hi[0] * wide_share; /* ties, then any */
            if (in_place && n >= 40 * dim) places[n] += away[n % dim];
        }
        memcpy(&places[30 * dim], (const double[3]){2.05, 0.62, 0.3}, (size_t)dim * sizeof *places); /* far from its wide point */
        MUST(b, peri_interpolate_field(b, PERI_FIELD_DISPLACEMENT, in_place, MANY, places, many, MANY * dim));
        for (int n = 0; n < MANY; ++n) {
            MUST(b, peri_interpolate_field(b, PERI_FIELD_DISPLACEMENT, in_place, 1, &places[n * dim], one, dim));
            CHECK(memcmp(one, &many[n * dim], (size_t)dim * sizeof *one) == 0 || (isnan(one[0]) && isnan(many[n * dim])));
            outside += isnan(one[0]) != 0;
        }
        CHECK(outside > 5 && outside < MANY - 3);
        peri_body_destroy(b);
    }
}

/* A half that slides along a cut: the places of each half move as it does, up to the cut; and NaN is what lies outside. */
static void cuts_and_outside(void) {
    specimen s = cells_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_PRECISION_DOUBLE, 0);
    peri_body *b = specimen_make(&s);
    const double a[2] = {-1, 0.6}, z[2] = {2, 0.6}, lo[2] = {-1, 0.6}, hi[2] = {2, 2}, slide[2] = {5, 0};
    const double places[14] = {0.33, 0.599, 0.33, 0.601, 0.7, 0.58, 0.01, 0.62, 1.3001, 0.5, 1.2001, 0.5, 0.5, -0.03};
    const double now[4] = {0.33, 0.59, 5.4, 0.61};
    double out[14];
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, a, z));
    MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), slide));
    MUST(b, peri_interpolate_field(b, PERI_FIELD_DISPLACEMENT, 0, 7, places, out, 14));
    for (int k = 0; k < 4; ++k) CHECK_NEAR(out[2 * k], k % 2 ? 5 : 0, 0, 1e-13);
    CHECK(isnan(out[8]) && isnan(out[9]));
    CHECK(fabs(out[10]) < 1e-13 && isnan(out[12]) == 0);
    MUST(b, peri_interpolate_field(b, PERI_FIELD_POSITION, 1, 2, now, out, 4));
    CHECK_NEAR(out[0], 0.33, 0, 1e-13);
    CHECK_NEAR(out[2], 0.4, 0, 1e-13);
    CHECK_NEAR(out[3], 0.61, 0, 1e-13);
    peri_body_destroy(b);
}

/* A periodic cell in x: 10 columns of its own between 6 of images. Places of its own are told, to its ends, those of images not; its bonds
   are those of its own points, and add up. */
static void parts_tell_of_their_own(void) {
    enum { COLUMNS = 22, OWN = 10, RIM = 6, ROWS = 8 };
    for (int32_t law = PERI_LAW_LPS; law <= PERI_LAW_CORRESPONDENCE; ++law) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, law, 0.2, 0.1, 2.5, COLUMNS, ROWS, 0);
        const double h[4] = {gradient[0], gradient[1], gradient[3], gradient[4]};
        const double places[10] = {0.6 + 1e-9, 0.33, 1.6 - 1e-9, 0.01, 1.11, 0.8, 0.549, 0.4, 1.7, 0.2};
        static int32_t ghosts[COLUMNS * ROWS], owners[COLUMNS * ROWS];
        double out[20];
        int64_t count = 0;
        peri_part_desc p;
        peri_energy e;
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, s.spacing));
        for (int32_t i = 0; i < COLUMNS * ROWS; ++i) {
            const int32_t x = i % COLUMNS, own = RIM + (x + 2 * OWN - RIM) % OWN;
            if (own != x) ghosts[count] = i, owners[count++] = i - x + own;
        }
        peri_part_desc_init(&p);
        p.length = 0.1;
        p.mean_volume = 0.01;
        p.ghost_count = count;
        p.ghosts = ghosts;
        p.owners = owners;
        MUST(b, peri_set_part(b, &p));
        MUST(b, peri_build(b));
        MUST(b, peri_set_mean_gradient(b, h));
        deform(b, 0);
        MUST(b, peri_interpolate_field(b, PERI_FIELD_DEFORMATION_GRADIENT, 0, 5, places, out, 20));
        for (int k = 0; k < 12; ++k) CHECK_NEAR(out[k], h[k % 4] + (k % 4 % 3 == 0), 0, 1e-11);
        for (int k = 12; k < 20; ++k) CHECK(isnan(out[k]));
        MUST(b, peri_interpolate_field(b, PERI_FIELD_DISPLACEMENT, 0, 5, places, out, 20));
        for (int k = 0; k < 6; ++k)
            CHECK_NEAR(out[k], 0.03 * (k % 2 + 1) + h[k % 2 * 2] * places[k - k % 2] + h[k % 2 * 2 + 1] * places[k - k % 2 + 1], 0, 1e-13);
        for (int k = 6; k < 10; ++k) CHECK(isnan(out[k]));
        double *v = get(b, PERI_FIELD_VELOCITY);
        for (int64_t k = 0; k < count; ++k) v[2 * ghosts[k]] = v[2 * ghosts[k] + 1] = 1e3; /* which nobody tells of */
        put(b, PERI_FIELD_VELOCITY, v);
        free(v);
        MUST(b, peri_interpolate_field(b, PERI_FIELD_VELOCITY, 0, 3, places, out, 6));
        for (int k = 0; k < 6; ++k)
            CHECK_NEAR(out[k], 0.03 * (k % 2 + 1) + h[k % 2 * 2] * places[k - k % 2] + h[k % 2 * 2 + 1] * places[k - k % 2 + 1], 0, 1e-13);
        const int64_t entries = MUST(b, peri_size_of_bonds(b, PERI_ALL, PERI_BOND_POINT));
        double *i = (double *)malloc((size_t)entries * sizeof *i), *w = (double *)malloc((size_t)entries * sizeof *w), sum = 0;
        double *f = (double *)malloc((size_t)entries * 2 * sizeof *f), *force = get(b, PERI_FIELD_FORCE_DENSITY);
        MUST(b, peri_get_bonds(b, PERI_ALL, PERI_BOND_POINT, i, entries));
        MUST(b, peri_get_bonds(b, PERI_ALL, PERI_BOND_ENERGY, w, entries));
        MUST(b, peri_get_bonds(b, PERI_ALL, PERI_BOND_FORCE, f, 2 * entries));
        for (int64_t k = 0; k < entries; ++k) {
            const int64_t at = (int64_t)i[k];
            CHECK(at % COLUMNS >= RIM && at % COLUMNS < RIM + OWN);
            sum += w[k] * 0.01;
            for (int d = 0; d < 2; ++d) force[2 * at + d] -= f[2 * k + d];
        }
        MUST(b, peri_get_energy(b, &e));
        CHECK_NEAR(sum, e.elastic, 1e-12, 0);
        for (int64_t k = 0; k < 2 * COLUMNS * ROWS; ++k)
            if (k / 2 % COLUMNS >= RIM && k / 2 % COLUMNS < RIM + OWN) CHECK_NEAR(force[k], 0, 0, 1e-12);
        free(i), free(w), free(f), free(force);
        peri_body_destroy(b);
    }
}

static void refused(void) {
    specimen s = cells_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_PRECISION_DOUBLE, 0);
    peri_body *b = specimen_make(&s), *none = specimen_start(&s);
    const int32_t points[3] = {0, 5, 9}, beyond[3] = {0, 144, -1};
    const double places[4] = {0.5, 0.5, 0.5, NAN};
    double out[9] = {-7, -7, -7, -7, -7, -7, -7, -7, -7};
    REFUSE(none, PERI_ERROR_ORDER, peri_get_field_at(none, PERI_FIELD_VOLUME, 3, points, out, 9));
    REFUSE(none, PERI_ERROR_ORDER, peri_interpolate_field(none, PERI_FIELD_VOLUME, 0, 1, places, out, 9));
    CHECK(peri_get_field_at(NULL, PERI_FIELD_VOLUME, 3, points, out, 9) == PERI_ERROR_ARGUMENT);
    CHECK(peri_interpolate_field(NULL, PERI_FIELD_VOLUME, 0, 1, places, out, 9) == PERI_ERROR_ARGUMENT);
    REFUSE(b, PERI_ERROR_CHOICE, peri_get_field_at(b, peri__end_field, 3, points, out, 9));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_field_at(b, PERI_FIELD_VOLUME, -1, points, out, 9));
    FIELD_IS("count");
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_field_at(b, PERI_FIELD_VOLUME, 3, NULL, out, 9));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_get_field_at(b, PERI_FIELD_VOLUME, 3, points, NULL, 9));
    REFUSE(b, PERI_ERROR_CAPACITY, peri_get_field_at(b, PERI_FIELD_STRAIN, 3, points, out, 8));
    CHECK(seen.value == 9);
    REFUSE(b, PERI_ERROR_INDEX, peri_get_field_at(b, PERI_FIELD_VOLUME, 3, beyond, out, 9));
    CHECK(seen.index == 1 && seen.value == 144);
    REFUSE(b, PERI_ERROR_CHOICE, peri_interpolate_field(b, PERI_FIELD_VOLUME, 2, 1, places, out, 9));
    FIELD_IS("in_place");
    REFUSE(b, PERI_ERROR_CHOICE, peri_interpolate_field(b, 3, 0, 1, places, out, 9));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_interpolate_field(b, PERI_FIELD_VOLUME, 0, -1, places, out, 9));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_interpolate_field(b, PERI_FIELD_VOLUME, 0, 1, NULL, out, 9));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_interpolate_field(b, PERI_FIELD_VOLUME, 0, 1, places, NULL, 9));
    REFUSE(b, PERI_ERROR_CAPACITY, peri_interpolate_field(b, PERI_FIELD_STRAIN, 0, 4, places, out, 9));
    REFUSE(b, PERI_ERROR_RANGE, peri_interpolate_field(b, PERI_FIELD_VOLUME, 0, 2, places, out, 9));
    FIELD_IS("places");
    CHECK(seen.index == 1);
    for (int k = 0; k < 9; ++k) CHECK(out[k] == -7);
    MUST(b, peri_get_field_at(b, PERI_FIELD_VOLUME, 0, points, out, 0));
    peri_body_destroy(b);
    peri_body_destroy(none);
}

/* A field that is had in one pass alone takes memory for a moment; where there is none the call says so and nothing is lost. */
static void short_memory(void) {
    static pool p;
    const int32_t points[1] = {4};
    const double place[2] = {0.5, 0.5};
    double out[4];
    specimen s = cells_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_CORRESPONDENCE, PERI_PRECISION_DOUBLE, 0);
    memset(&p, 0, sizeof p);
    p.fail_at = -1;
    hook(&s.desc, &p);
    peri_body *b = specimen_make(&s);
    deform(b, 1e-3);
    double *w = get(b, PERI_FIELD_ENERGY_DENSITY);
    const int64_t blocks = p.blocks;
    const int64_t calls = p.calls;
    MUST(b, peri_get_field_at(b, PERI_FIELD_STRAIN, 1, points, out, 3));
    MUST(b, peri_interpolate_field(b, PERI_FIELD_STRESS, 0, 1, place, out, 3));
    CHECK(p.calls == calls); /* by point: none */
    p.fail_at = p.calls;
    REFUSE(b, PERI_ERROR_MEMORY, peri_get_field_at(b, PERI_FIELD_ENERGY_DENSITY, 1, points, out, 1));
    p.fail_at = p.calls;
    REFUSE(b, PERI_ERROR_MEMORY, peri_interpolate_field(b, PERI_FIELD_ENERGY_DENSITY, 0, 1, place, out, 1));
    const double row[10] = {0.1, 0.3, 0.2, 0.3, 0.3, 0.3, 0.4, 0.3, 0.55, 0.3};
    double with[15], without[15];
    MUST(b, peri_interpolate_field(b, PERI_FIELD_STRAIN, 0, 5, row, with, 15));
    for (int k = 0; k < 2; ++k) { /* many places take some, and do without */
        p.fail_at = p.calls + k;
        MUST(b, peri_interpolate_field(b, PERI_FIELD_STRAIN, 0, 5, row, without, 15));
        CHECK(p.calls > p.fail_at && memcmp(with, without, sizeof with) == 0 && p.blocks == blocks);
    }
    p.fail_at = p.calls;
    double *bonds = (double *)malloc((size_t)peri_entry_count(b) * sizeof *bonds);
    REFUSE(b, PERI_ERROR_MEMORY, peri_get_bonds(b, PERI_ALL, PERI_BOND_ENERGY, bonds, peri_entry_count(b)));
    p.fail_at = -1;
    MUST(b, peri_get_bonds(b, PERI_ALL, PERI_BOND_ENERGY, bonds, peri_entry_count(b)));
    MUST(b, peri_get_field_at(b, PERI_FIELD_ENERGY_DENSITY, 1, points, out, 1));
    CHECK(out[0] == w[4] && p.blocks == blocks && p.wrong == 0);
    free(w);
    free(bonds);
    peri_body_destroy(b);
    CHECK(p.blocks == 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(subset_is_the_field);
    RUN(gradient_is_that_of_affine_motion);
    RUN(gradient_of_thin_families);
    RUN(linear_fields_are_exact);
    RUN(smoothing_of_the_convergence_study);
    RUN(cells_count_by_volume);
    RUN(many_places_are_as_one);
    RUN(cuts_and_outside);
    RUN(parts_tell_of_their_own);
    RUN(refused);
    RUN(short_memory);
    return test_end("test_probes");
}
