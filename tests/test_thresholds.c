/* SPDX-License-Identifier: MIT */
/* test_thresholds.c - where an answer changes its kind: just short of the threshold and just beyond it.

   SOURCE OF TRUTH: docs/theory.md and docs/statics.md for the thresholds; on either side the energy of the solid, that of a few springs, or
   the compromise of the moment correction, worked out by hand for families with few directions. */
#include "solid.h"
#include "equilibrium.h"

/* ---- the moment correction: exact where no factor is 10 or more --------------------------------------------------- */

/* w of the bonds longer than 0.8 horizons; 1 else. */
static int32_t step_down(void *user, double q, double *w) {
    *w = q < 0.8 ? 1 : *(const double *)user;
    return 0;
}

/* The energy density of the point in the middle of a lattice of side x side cells of 1 x `high`, over that of the solid, under the packed
   strain; LPS in plane stress, horizon `reach`. */
static double middle_energy(double reach, double far_, double high, int32_t correction, const double *eps) {
    enum { SIDE = 9 };
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, correction);
    double x[2 * SIDE * SIDE], volume[SIDE * SIDE], h[4], *w, got;
    specimen p;
    peri_body *b;
    int i;
    s.spacing = 1;
    s.ratio = reach;
    p = solid_specimen(&s, 1, 1, 1);
    p.desc.influence = PERI_INFLUENCE_USER;
    p.desc.influence_fn = step_down;
    p.desc.influence_user = &far_;
    b = specimen_start(&p);
    for (i = 0; i < SIDE * SIDE; ++i) {
        x[2 * i] = i % SIDE;
        x[2 * i + 1] = high * (i / SIDE);
        volume[i] = high;
    }
    (void)MUST(b, peri_add_points(b, SIDE * SIDE, x, volume, NULL));
    (void)MUST(b, peri_build(b));
    strain_matrix(2, eps, h);
    stretch_by(b, h);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    got = w[SIDE * SIDE / 2] / solid_energy(&s, eps);
    free(w);
    peri_body_destroy(b);
    return got;
}

/* Four bonds of length 1 along the axes, shares a in m all together, and four diagonal ones, b = 1 - a. The fourth moment is isotropic
   where a x_a = b x_b = 1/2, x the factors: x_b = 1/(2 b). The compromise is the minimum of
       (a x_a^2 + b x_b^2)/2 - lambda.I + 0.01 |lambda|^2/2,    lambda.n^4 = c + d cos(4 phi),    x_a = 1 + c + d,    x_b = 1 + c - d.
   That lambda is the symmetric tensor c (delta delta + ..)/3 + d Re (n_1 + i n_2)^4, so lambda.I = c and |lambda|^2 = 8 c^2/3 + 8 d^2.
   Shear along the axes has the energy mu gamma^2/2 times 8 sum a x n_1^2 n_2^2 = 2 b x_b. */
static void fits_with_factors_up_to_ten(void) {
    static const double shear[3] = {0, 0, 1e-3}, factor[4] = {9, 9.99, 10.01, 12};
    int k;
    for (k = 0; k < 4; ++k) {
        const double b = 0.5 / factor[k], a = 1 - b, far_ = 0.5 * b / a; /* b/a = 4 far 2/4 */
        const double s = 0.01, p = 1 + 8 * s / 3, q = 1 + 8 * s, d = -(a - b) / (q - (a - b) * (a - b) / p), c = -(a - b) * d / p;
        const double xa = 1 + c + d, xb = 1 + c - d;
        CHECK(xa > 0 && xb > 0);
        CHECK_NEAR(middle_energy(1.5, far_, 1, PERI_CORRECTION_NONE, shear), 2 * b, 1e-10, 0);
        CHECK_NEAR(middle_energy(1.5, far_, 1, PERI_CORRECTION_MOMENT, shear), k < 2 ? 1 : 2 * b * xb / (a * xa + b * xb), 1e-10, 0);
    }
}

/* Bonds along the axes alone, of lengths 1 and 1.2: no factors make the fourth moment isotropic, for that of shear is 0 whatever they are.
   With shares a, b the compromise has a x_a + 0.01 (x_a - 1) = 3/8, b likewise: lambda has the components x_a - 1 and x_b - 1 along n_1^4,
   n_2^4. The energy of eps_xx, theta = 2 a x_a eps: (lambda - mu) (2 a x_a eps)^2/2 + 4 mu a x_a eps^2, a x_a over a x_a + b x_b. */
static void no_fit_at_all(void) {
    static const double pulled[3] = {1e-3, 0, 0};
    const double high = 1.2, a = 1 / (1 + high * high), b = 1 - a, s = 0.01;
    const double ax = a * (0.375 + s) / (a + s), bx = b * (0.375 + s) / (b + s), part = ax / (ax + bx);
    solid solid_ = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_MOMENT);
    double lambda, mu;
    lame(PERI_SPACE_PLANE_STRESS, solid_.nu, &lambda, &mu);
    CHECK(fabs(part - 0.5) > 1e-3); /* of an exact fit of what there is: 1/2 */
    CHECK_NEAR(middle_energy(1.3, 1, high, PERI_CORRECTION_MOMENT, pulled),
               ((lambda - mu) * 2 * part * part + 4 * mu * part) / (0.5 * lambda + mu), 1e-10, 0);
}

/* ---- correspondence: families that span too little ---------------------------------------------------------------- */

/* A cross: bonds of length 1 along all axes but the last, `thin` along that one. K has the eigenvalues 1 and thin^2. Below 1/50 the point
   in the middle acts by springs B w e/m0, of energy B/(2 m0) sum w e^2 V, and its strain is that of what the rest spans. */
static void thin_families(void) {
    static const double ratio[4] = {40, 49.5, 50.5, 60};
    int32_t space;
    int k, a, c;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (k = 0; k < 4; ++k) {
            solid s = solid_of(space, PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE);
            const int dim = dim_of(space), n = 2 * dim + 1, last = dim - 1, parts = parts_of(dim);
            const double thin = sqrt(1 / ratio[k]), eps = 1e-3;
            const moduli e = moduli_of(space, s.nu);
            double x[21] = {0}, volume[7], packed_[6] = {0}, h[9], *w, *strain, m0 = 0, springs = 0;
            peri_body *b;
            s.spacing = 1;
            s.ratio = 1.05;
            s.stabilization = 0;
            b = solid_new(&s);
            for (a = 0; a < n; ++a) volume[a] = 1;
            for (a = 0; a < dim; ++a)
                for (c = 0; c < 2; ++c) {
                    const double length = a == last ? thin : 1;
                    x[(1 + 2 * a + c) * dim + a] = c ? -length : length;
                    m0 += length * length;
                    springs += a == last ? thin * thin * eps * eps : 0;
                }
            (void)MUST(b, peri_add_points(b, n, x, volume, NULL));
            (void)MUST(b, peri_build(b));
            packed_[packed(dim, last, last)] = eps;
            strain_matrix(dim, packed_, h);
            stretch_by(b, h);
            w = get(b, PERI_FIELD_ENERGY_DENSITY);
            strain = get(b, PERI_FIELD_STRAIN);
            CHECK_NEAR(w[0], k < 2 ? solid_energy(&s, packed_) : 0.5 * e.b / m0 * springs, 1e-10, 0);
            for (a = 0; a < parts; ++a) CHECK_NEAR(strain[a], k < 2 ? packed_[a] : 0, 0, 1e-12 * eps);
            free(w);
            free(strain);
            peri_body_destroy(b);
        }
}

/* ---- weights next to nothing -------------------------------------------------------------------------------------- */

static int32_t alike(void *user, double q, double *w) {
    (void)q;
    *w = *(const double *)user;
    return 0;
}

/* peri.h: w is 0, or 1e-100 < |w| < 1e100. Less is taken as 0: then no point has a weight. */
static void weights_below_their_range(void) {
    static const double w[4] = {1.01e-100, 2e-100, 0.99e-100, -0.99e-100};
    int32_t law;
    int k;
    for (law = PERI_LAW_BOND_BASED; law <= PERI_LAW_LPS; ++law)
        for (k = 0; k < 4; ++k) {
            specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 2.05, 5, 5, 1);
            double value = w[k];
            peri_body *b;
            p.desc.influence = PERI_INFLUENCE_USER;
            p.desc.influence_fn = alike;
            p.desc.influence_user = &value;
            b = specimen_start(&p);
            (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), p.lo, p.hi, 1));
            CHECK(peri_build(b) == (k < 2 ? PERI_OK : law == PERI_LAW_BOND_BASED ? PERI_ERROR_INFLUENCE : PERI_ERROR_FAMILY));
            peri_body_destroy(b);
        }
}

/* ---- statics: what holds a part ----------------------------------------------------------------------------------- */

/* Springs: LPS at the ratio of a bond-based material, which takes influence functions that jump. */
static peri_body *points_of(int n, const double *x, double reach, double *far_) {
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
    double volume[32];
    specimen p;
    peri_body *b;
    int i;
    s.nu = bond_nu(PERI_SPACE_PLANE_STRESS);
    s.spacing = 1;
    s.ratio = reach;
    p = solid_specimen(&s, 1, 1, 1);
    if (far_) {
        p.desc.influence = PERI_INFLUENCE_USER;
        p.desc.influence_fn = step_down;
        p.desc.influence_user = far_;
    }
    b = specimen_start(&p);
    for (i = 0; i < n; ++i) volume[i] = 1;
    (void)MUST(b, peri_add_points(b, n, x, volume, NULL));
    (void)MUST(b, peri_build(b));
    return b;
}

static int32_t first_points(peri_body *b, int32_t first, int32_t count) {
    int32_t points[32], k;
    for (k = 0; k < count; ++k) points[k] = first + k;
    return (int32_t)MUST(b, peri_select_points(b, NULL, count, points));
}

/* Two squares of 3 x 3 points, 2 apart; bonds of length 2 weigh far, on both sides: 2 far of the heaviest bond. Below 1e-7 they join
   nothing, and the second square is loose: 3 motions, of point 9. */
static void weightless_bonds_join_nothing(void) {
    static const double weights[4] = {1e-5, 0.55e-7, 0.45e-7, 1e-9};
    double x[36];
    int k, i;
    for (i = 0; i < 18; ++i) {
        x[2 * i] = i % 3 + 4 * (i / 9);
        x[2 * i + 1] = i / 3 % 3;
    }
    for (k = 0; k < 4; ++k) {
        double far_ = weights[k];
        peri_body *b = points_of(18, x, 2.05, &far_);
        peri_solve_desc s = statics_of(1e-8);
        peri_solve_report r;
        peri_error e;
        s.loose = PERI_LOOSE_REFUSED;
        (void)MUST(b, peri_prescribe_displacement(b, first_points(b, 0, 9), PERI_AXIS_XY, NULL, NULL, NULL));
        CHECK(peri_solve(b, &s, &r) == (k < 2 ? PERI_OK : PERI_ERROR_LOOSE));
        if (k >= 2) CHECK(peri_get_error(b, &e) == PERI_OK && e.index == 9 && e.value == 3);
        peri_body_destroy(b);
    }
}

/* A point between two held ones along x, and two along y whose bonds weigh far, and which have another neighbour each: stiffness across is
   about far of that along, and below 1e-9 the point counts as held across only where the bonds are no weightless ones. */
static void weightless_bonds_hold_nothing(void) {
    static const double x[14] = {0, 0, 1, 0, -1, 0, 0, 1.3, 0, -1.3, 0, 1.9, 0, -1.9}, weights[3] = {1e-6, 1e-8, 1e-10};
    int k;
    for (k = 0; k < 3; ++k) {
        double far_ = weights[k];
        peri_body *b = points_of(7, x, 1.4, &far_);
        peri_solve_desc s = statics_of(1e-8);
        peri_solve_report r;
        peri_error e;
        s.loose = PERI_LOOSE_REFUSED;
        (void)MUST(b, peri_prescribe_displacement(b, first_points(b, 1, 6), PERI_AXIS_XY, NULL, NULL, NULL));
        CHECK(peri_solve(b, &s, &r) == (k < 2 ? PERI_OK : PERI_ERROR_LOOSE));
        if (k == 2) CHECK(peri_get_error(b, &e) == PERI_OK && e.index == 0);
        peri_body_destroy(b);
    }
}

/* The same cross with neighbours of a soft material across: the bonds weigh alike, so the point is held, by springs c V V/|xi| of the
   harmonic mean of both c, 2e-11 of that along, which is less than the 1e-9 above. */
static void soft_bonds_hold(void) {
    static const double x[10] = {0, 0, 1, 0, -1, 0, 0, 1, 0, -1}, volume[5] = {1, 1, 1, 1, 1}, density[2] = {0, 1e-15};
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE);
    peri_solve_desc statics = statics_of(1e-10);
    peri_material_desc soft;
    peri_solve_report r;
    int32_t materials[5], stiff, k;
    double c = 0, *u;
    peri_body *b;
    s.spacing = 1;
    s.ratio = 1.05;
    soft = solid_material(&s);
    b = solid_new(&s);
    stiff = peri_id(b, PERI_KIND_MATERIAL, 1);
    soft.young = 1e-11 * YOUNG;
    materials[3] = materials[4] = (int32_t)MUST(b, peri_add_material(b, &soft));
    for (k = 0; k < 3; ++k) materials[k] = stiff;
    (void)MUST(b, peri_add_points(b, 5, x, volume, materials));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_get_bond_constants(b, stiff, materials[3], &c, NULL));
    (void)MUST(b, peri_prescribe_displacement(b, first_points(b, 1, 4), PERI_AXIS_XY, NULL, NULL, NULL));
    (void)MUST(b, peri_apply_body_force(b, first_points(b, 0, 1), density, NULL, NULL));
    statics.loose = PERI_LOOSE_REFUSED;
    (void)MUST(b, peri_solve(b, &statics, &r));
    u = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK_NEAR(u[1], density[1] / (2 * c * THICK), 1e-8, 0); /* c: per volume, of points 1 x 1 x THICK */
    CHECK_NEAR(u[0], 0, 0, 1e-8 * u[1]);
    free(u);
    peri_body_destroy(b);
}

/* A square of 3 x 3 points and one more, `near` of a corner: both held, across the line between them the one, both ways the other. Nothing
   but that holds the turn, and it does: where the one moves across by near*angle the body turns by the angle as a whole, unstrained. */
static void weakly_held_parts(void) {
    static const double nears[2] = {1e-2, 1e-4};
    int k, i;
    for (k = 0; k < 2; ++k) {
        const double angle = 1e-3, aside[2] = {0, nears[k] * angle};
        double x[20], *u, off = 0;
        peri_body *b;
        peri_solve_desc s = statics_of(1e-12);
        peri_solve_report r;
        for (i = 0; i < 9; ++i) {
            x[2 * i] = i % 3;
            x[2 * i + 1] = i / 3;
        }
        x[18] = nears[k];
        x[19] = 0;
        b = points_of(10, x, 2.05, NULL);
        s.loose = PERI_LOOSE_REFUSED;
        (void)MUST(b, peri_prescribe_displacement(b, first_points(b, 0, 1), PERI_AXIS_XY, NULL, NULL, NULL));
        (void)MUST(b, peri_prescribe_displacement(b, first_points(b, 9, 1), PERI_AXIS_Y, aside, NULL, NULL));
        CHECK(peri_solve(b, &s, &r) == PERI_OK);
        u = get(b, PERI_FIELD_DISPLACEMENT);
        for (i = 0; i < 10; ++i) off = fmax(off, fmax(fabs(u[2 * i] + angle * x[2 * i + 1]), fabs(u[2 * i + 1] - angle * x[2 * i])));
        if (test_long) printf("    points %g apart: off by %.1e\n", nears[k], off / angle);
        CHECK(off < 1e-4 * angle);
        free(u);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(fits_with_factors_up_to_ten);
    RUN(no_fit_at_all);
    RUN(thin_families);
    RUN(weights_below_their_range);
    RUN(weightless_bonds_join_nothing);
    RUN(weightless_bonds_hold_nothing);
    RUN(soft_bonds_hold);
    RUN(weakly_held_parts);
    return test_end("test_thresholds");
}
