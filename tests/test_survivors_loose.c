/* SPDX-License-Identifier: MIT */
/* test_survivors_loose.c - what `make mutants` found that no other test of loose parts, matrices and spread loads looked at.

   SOURCE OF TRUTH: peri.h and docs/statics.md (Loose parts, The stiffness, Tractions and pressures); the count of the rigid motions
   of points that are held in one place; balance of forces; the matrix and the product are of one tangent. */
#include "refusal.h"

static int32_t side(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e9, -1e9}, hi[3] = {to, 1e9, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}
static int32_t one(peri_body *b, int32_t point) { return (int32_t)MUST(b, peri_select_points(b, NULL, 1, &point)); }
static int32_t axes_of(const peri_body *b) { return peri_dimension(b) == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY; }
static void hold(peri_body *b, int32_t set) { MUST(b, peri_prescribe_displacement(b, set, axes_of(b), NULL, NULL, NULL)); }

/* Refused: the index is one of from..to - 1, the value the number of free motions. */
static void loose_at(peri_body *b, int64_t from, int64_t to, double motions) {
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    REFUSE(b, PERI_ERROR_LOOSE, peri_solve(b, &s, NULL));
    CHECK(seen.index >= from && seen.index < to && seen.value == motions);
}
static peri_solve_report solve(peri_body *b, int32_t loose) {
    peri_solve_desc s;
    peri_solve_report r;
    peri_solve_desc_init(&s);
    s.loose = loose;
    memset(&r, 0, sizeof r);
    MUST(b, peri_solve(b, &s, &r));
    return r;
}

static peri_body *plate(int32_t space, int32_t law, int nx, int ny, int nz, int32_t geometry) {
    specimen s = specimen_of(space, law, 0.3, 1, 2.2, nx, ny, nz);
    s.desc.geometry = geometry;
    return specimen_make(&s);
}

/* ---- rigid motions -------------------------------------------------------------------------------------------------- */

/* Held at one point a body can turn about it: one motion in a plane, three in space, whichever point it is. */
static void pivots(void) {
    int32_t space, i;
    for (space = PERI_SPACE_PLANE_STRESS; space <= PERI_SPACE_SOLID; space += 2)
        for (i = 0; i < 20; ++i) {
            const int solid = space == PERI_SPACE_SOLID;
            peri_body *b = plate(space, PERI_LAW_BOND_BASED, 5, solid ? 2 : 4, 2, PERI_GEOMETRY_LINEAR);
            const int64_t n = peri_point_count(b);
            hold(b, one(b, i));
            loose_at(b, 0, n, solid ? 3 : 1);
            CHECK(solve(b, PERI_LOOSE_BALANCED).loose == (solid ? 3 : 1));
            peri_body_destroy(b);
        }
}

/* A row of points in space has five: its turn about itself moves nothing. A point alone has as many as there are axes. */
static void rows_and_points(void) {
    double x[24];
    int turned, k;
    for (turned = 0; turned < 4; ++turned) {
        const double axis[4][3] = {{1, 0, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {0.48, 0.6, 0.64}};
        double volumes[8];
        specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 2.2, 1, 1, 1);
        peri_body *b = specimen_start(&s);
        for (k = 0; k < 24; ++k) x[k] = (k / 3) * axis[turned][k % 3];
        for (k = 0; k < 8; ++k) volumes[k] = 1;
        MUST(b, peri_add_points(b, 8, x, volumes, NULL));
        MUST(b, peri_build(b));
        loose_at(b, 0, 8, 5);
        peri_body_destroy(b);
    }
    for (k = 0; k < 2; ++k) {
        const double from[2] = {-1, 1}, to[2] = {1, 1}, up[2] = {1, -1}, down[2] = {1, 1};
        double *u;
        peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 8, 4, 1, k ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR);
        hold(b, side(b, 5, 8));
        MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
        MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, up, down)); /* point 0 is alone */
        loose_at(b, 0, 1, 2);
        CHECK(solve(b, PERI_LOOSE_BALANCED).loose == 2);
        CHECK(solve(b, PERI_LOOSE_PINNED).loose == 2);
        u = get(b, PERI_FIELD_DISPLACEMENT);
        CHECK(largest(u, 64) == 0);
        free(u);
        peri_body_destroy(b);
    }
}

/* The index is a point of the loose part, also where that is the second one. */
static void the_part_is_told(void) {
    const double from[2] = {6, -1}, to[2] = {6, 9};
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 12, 1, 1, PERI_GEOMETRY_LINEAR);
    hold(b, side(b, 0, 3));
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    loose_at(b, 6, 12, 3);
    peri_body_destroy(b);
}

/* "Bonds that weigh less than 1e-7 of the heaviest of the family join and hold nothing": two parts, two spacings apart, joined by those
   alone. */
static int32_t steep(void *user, double q, double *w) {
    *w = exp(-*(const double *)user * q * q * q * q);
    return 0;
}
static void weightless_bonds_do_not_join(void) {
    double slope; /* 2/2.2 of the horizon away 1e-5 at 17, 1e-10 at 34 */
    for (slope = 17; slope < 50; slope *= 2) {
        const double lo[2] = {0, 0}, hi[2] = {6, 3}, next[2] = {7, 0}, far[2] = {13, 3};
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 1, 1, 1);
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        s.desc.influence = PERI_INFLUENCE_USER;
        s.desc.influence_fn = steep;
        s.desc.influence_user = &slope;
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
        MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), next, far, 1));
        MUST(b, peri_build(b));
        hold(b, side(b, 0, 2));
        if (slope > 20) loose_at(b, 18, 36, 3);
        else CHECK(solve(b, PERI_LOOSE_BALANCED).loose == 0);
        peri_body_destroy(b);
    }
}

/* Of the bonds of a corner all are cut but those along x: nothing resists its way along y. */
static int32_t all_but_along(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)j;
    return i == 0 && xi[1] != xj[1];
}
static void points_that_hang_on_a_line(void) {
    const double force[2] = {0, 1e-3};
    double *u;
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 8, 4, 1, PERI_GEOMETRY_LINEAR);
    hold(b, side(b, 5, 8));
    MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, all_but_along, NULL));
    MUST(b, peri_apply_body_force(b, one(b, 0), force, NULL, NULL));
    loose_at(b, 0, 1, 0);
    (void)solve(b, PERI_LOOSE_BALANCED); /* "leave out the force on what is not resisted" */
    u = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(fabs(u[0]) < 1e-6 && fabs(u[1]) < 1e-6);
    free(u);
    peri_body_destroy(b);
}

/* Supports along x alone, held across by an obstacle that touches: one that moves is where it is at the factor. */
static int32_t rise(void *user, double time, double *place, double *turn) {
    (void)turn;
    *(double *)user = time;
    place[0] = 4;
    place[1] = -1 + 1.4 * time; /* of a half space below; the lowest points are at 0.5 and are met by 1.5e-1 and more */
    return 0;
}
static void obstacles_hold_where_they_are_now(void) {
    const double place[2] = {4, -1}, normal[2] = {0, 1}, down[2] = {0, -1e-2};
    double time = -1, force[2];
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 8, 4, 1, PERI_GEOMETRY_LINEAR);
    peri_solve_desc s;
    const int32_t held = (int32_t)MUST(b, peri_prescribe_displacement(b, side(b, 0, 8), PERI_AXIS_X, NULL, NULL, NULL));
    const int32_t ground = (int32_t)MUST(b, plane_obstacle(b, place, normal, 1, rise, &time));
    MUST(b, peri_apply_body_force(b, PERI_ALL, down, NULL, NULL));
    (void)held;
    peri_solve_desc_init(&s);
    s.load_to = 1.25; /* the ground is at 0.75 then, and the points in it */
    MUST(b, peri_solve(b, &s, NULL));
    CHECK(time == 1.25);
    MUST(b, peri_get_obstacle_force(b, ground, force, NULL));
    CHECK_NEAR(force[1], 32 * 1.25e-2, 1e-6, 0); /* 32 points of volume 1 */
    MUST(b, peri_remove_obstacle(b, ground));
    loose_at(b, 0, 32, 1);
    peri_body_destroy(b);
}

/* d'Alembert: loads that strain a free body of two densities and drive nothing leave its centre of mass where it is. */
static void free_bodies_keep_their_centre(void) {
    const double lo[2] = {0, 0}, hi[2] = {6, 4}, next[2] = {6, 0}, far[2] = {12, 4}, left[2] = {-1e-3, 0}, right[2] = {1e-3, 0};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1, 2.2, 1, 1, 1);
    peri_body *b = specimen_start(&s);
    peri_material_desc m = s.material;
    double *u, sum = 0, mean = 0;
    int k;
    m.density = 7;
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &m)), next, far, 1));
    MUST(b, peri_build(b));
    MUST(b, peri_apply_body_force(b, side(b, 0, 1), left, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, 11, 12), right, NULL, NULL));
    CHECK(solve(b, PERI_LOOSE_BALANCED).loose == 3);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    for (k = 0; k < 48; ++k) {
        sum += (k < 24 ? 1 : 7) * u[2 * k];
        mean += fabs(u[2 * k]);
    }
    CHECK(fabs(sum) < 1e-6 * mean && mean > 1e-3);
    free(u);
    peri_body_destroy(b);
}

/* ---- the matrix ----------------------------------------------------------------------------------------------------- */

typedef struct rows {
    int64_t n, entries, *start;
    int32_t *column;
    double  *value;
} rows;

static rows rows_of(peri_body *b) {
    rows a;
    peri_matrix *m = NULL;
    MUST(b, peri_matrix_create(b, &m));
    a.n = peri_matrix_rows(m);
    a.entries = peri_matrix_entries(m);
    a.start = (int64_t *)calloc((size_t)a.n + 1, sizeof *a.start);
    a.column = (int32_t *)calloc((size_t)a.entries, sizeof *a.column);
    a.value = (double *)calloc((size_t)a.entries, sizeof *a.value);
    CHECK(peri_get_matrix(m, a.start, a.column, a.value) == PERI_OK);
    peri_matrix_destroy(m);
    return a;
}
static void rows_free(rows *a) {
    free(a->start);
    free(a->column);
    free(a->value);
}

/* "column[entries] ascending in each row"; as many of them as points couple; of a strained body, too, it is what
   peri_multiply_stiffness multiplies by. */
static void matrices_of_torn_bodies(void) {
    int32_t law;
    for (law = PERI_LAW_BOND_BASED; law <= PERI_LAW_CORRESPONDENCE; ++law) {
        const double from[2] = {-1, 3}, to[2] = {6, 3}, ahead[2] = {3, -1}, back[2] = {3, 7};
        peri_body *b = plate(PERI_SPACE_PLANE_STRESS, law, 9, 6, 1, PERI_GEOMETRY_NONLINEAR);
        double *x = get(b, PERI_FIELD_POSITION), u[108], in[108], out[108];
        int64_t i, k;
        uint64_t seed = 5;
        rows a;
        for (i = 0; i < 54; ++i) {
            u[2 * i] = 0.2 * x[2 * i] + 0.02 * test_random(&seed);
            u[2 * i + 1] = 0.15 * x[2 * i + 1] + 0.02 * test_random(&seed);
        }
        for (i = 0; i < 108; ++i) in[i] = test_random(&seed) - 0.5;
        put(b, PERI_FIELD_DISPLACEMENT, u);
        MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to));
        MUST(b, peri_cut_segment(b, PERI_CUT_NOW, ahead, back));
        a = rows_of(b);
        for (i = 0; i < a.n; ++i)
            for (k = a.start[i] + 1; k < a.start[i + 1]; ++k) CHECK(a.column[k] > a.column[k - 1]);
        if (law == PERI_LAW_BOND_BASED)
            CHECK(a.entries == 4 * (54 + 2 * (peri_bond_count(b) - peri_cut_count(b) - peri_broken_count(b))));
        MUST(b, peri_multiply_stiffness(b, in, out, 108));
        for (i = 0; i < 108; ++i) {
            double sum = 0;
            for (k = a.start[i]; k < a.start[i + 1]; ++k) sum += a.value[k] * in[a.column[k]];
            CHECK_NEAR(sum, out[i], 1e-9, 1e-9);
        }
        rows_free(&a);
        free(x);
        peri_body_destroy(b);
    }
}

/* K is linear, also in vectors whose inverse is no number: in 2^-1060 of whole numbers nothing is lost, E makes up for it. */
static void products_with_tiny_vectors(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 6, 4, 1);
    double in[48], large[48], small[48];
    int k;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.young = 1e30;
    peri_body *b = specimen_make(&s);
    for (k = 0; k < 48; ++k) in[k] = (k * 7) % 11 - 5;
    MUST(b, peri_multiply_stiffness(b, in, large, 48));
    for (k = 0; k < 48; ++k) in[k] = ldexp(in[k], -1060);
    MUST(b, peri_multiply_stiffness(b, in, small, 48));
    for (k = 0; k < 48; ++k) CHECK_NEAR(ldexp(small[k], 1060), large[k], 1e-12, 1e-12 * 1e30);
    peri_body_destroy(b);
}

/* ---- spread loads --------------------------------------------------------------------------------------------------- */

/* "the total force is exact" of tractions, along the normal and across it, in space and on each side. */
static void tractions_add_up(void) {
    int32_t law;
    int axis, along, way;
    for (law = PERI_LAW_BOND_BASED; law < PERI_LAW_CORRESPONDENCE; ++law) /* whose sets want two horizons */
        for (axis = 0; axis < 3; ++axis)
            for (along = 0; along < 3; ++along)
                for (way = -1; way <= 1; way += 2) {
                    double normal[3] = {0, 0, 0}, value[3] = {0, 0, 0}, lo[3] = {-9, -9, -9}, hi[3] = {9, 9, 9}, force[3];
                    peri_body *b = plate(PERI_SPACE_SOLID, law, 5, 5, 5, PERI_GEOMETRY_LINEAR);
                    int d;
                    normal[axis] = way;
                    value[along] = 1e-3;
                    if (way > 0) lo[axis] = 2.6;
                    else hi[axis] = 2.4;
                    const int32_t set = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
                    const int32_t load = (int32_t)MUST(b, peri_apply_traction(b, set, 25, normal, value, NULL, NULL));
                    MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0, 0));
                    MUST(b, peri_get_reaction(b, load, force));
                    for (d = 0; d < 3; ++d) CHECK_NEAR(force[d], d == along ? 25e-3 : 0, 1e-9, 1e-9);
                    peri_body_destroy(b);
                }
}

/* "each cut bond between two points of the set": where the set lies on one side of the crack there is none. */
static void bond_pressure_wants_both_sides(void) {
    const double from[2] = {-1, 3}, to[2] = {9, 3}, lo[2] = {0, 0}, hi[2] = {8, 3}, up[2] = {8, 6};
    peri_body *b = plate(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 8, 6, 1, PERI_GEOMETRY_LINEAR);
    double *f;
    int k;
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    const int32_t below = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    REFUSE(b, PERI_ERROR_EMPTY, peri_apply_bond_pressure_for_comparison(b, below, 1e-3, NULL, NULL));
    MUST(b, peri_apply_bond_pressure_for_comparison(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, up)), 1e-3, NULL, NULL));
    hold(b, PERI_ALL);
    (void)solve(b, PERI_LOOSE_REFUSED);
    f = get(b, PERI_FIELD_REACTION); /* supports hold what presses: rows 2 and 3, a cell of face to each point */
    for (k = 0; k < 48; ++k) CHECK_NEAR(f[2 * k + 1], k / 8 == 2 ? 1e-3 : k / 8 == 3 ? -1e-3 : 0, 1e-9, 1e-12);
    free(f);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(pivots);
    RUN(rows_and_points);
    RUN(the_part_is_told);
    RUN(weightless_bonds_do_not_join);
    RUN(points_that_hang_on_a_line);
    RUN(obstacles_hold_where_they_are_now);
    RUN(free_bodies_keep_their_centre);
    RUN(matrices_of_torn_bodies);
    RUN(products_with_tiny_vectors);
    RUN(tractions_add_up);
    RUN(bond_pressure_wants_both_sides);
    return test_end("test_survivors_loose");
}
