/* SPDX-License-Identifier: MIT */
/* test_survivors_loads.c - what `make mutants` found that no other quick test looked at: the ledger of solves that are changed on the way,
   contact, single points, fracture between materials.

   SOURCE OF TRUTH: the first law (in linear geometry the work between two equilibria is that of the mean force, exactly); balance of
   forces; peri.h: what breaks when, what a failure names. */
#include "refusal.h"

static peri_body *plate_of(int32_t law, int nx, int ny, int32_t geometry) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 1, 2.2, nx, ny, 1);
    s.desc.geometry = geometry;
    return specimen_make(&s);
}

static int32_t part_of(peri_body *b, double from, double to) {
    const double lo[2] = {from, -1e9}, hi[2] = {to, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* ---- the ledger ---------------------------------------------------------------------------------------------------- */

typedef struct change {
    int cut, load, move, step;
} change;

static int32_t change_body(void *user, peri_body *b) {
    static const double from[2] = {6, -1}, to[2] = {6, 2}, force[2] = {2e-3, 1e-3};
    change *c = (change *)user;
    if (++c->step == 1 && c->cut) CHECK(peri_cut_segment(b, PERI_CUT_NOW, from, to) > 0);
    if (c->step == 2 && c->load) CHECK(peri_apply_body_force(b, PERI_ALL, force, NULL, NULL) > 0);
    return c->step == 4 && c->move; /* > 0 stops */
}

static void the_ledger_closes(void) {
    int k;
    for (k = 0; k < 8; ++k) {
        const double force[2] = {1e-3, 3e-3};
        change c = {k & 1, k >> 1 & 1, k >> 2, 0};
        peri_solve_desc s;
        peri_energy e;
        peri_body *b = plate_of(k % 3 ? PERI_LAW_LPS : PERI_LAW_BOND_BASED, 12, 5, PERI_GEOMETRY_LINEAR);
        MUST(b, peri_prescribe_displacement(b, part_of(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
        MUST(b, peri_apply_body_force(b, part_of(b, 9, 12), force, NULL, NULL));
        peri_solve_desc_init(&s);
        s.steps = 5;
        s.tolerance = 1e-12;
        s.on_step = change_body;
        s.user = &c;
        CHECK(peri_solve(b, &s, NULL) == (c.move ? PERI_STOPPED : PERI_OK));
        MUST(b, peri_get_energy(b, &e));
        CHECK(e.elastic > 0 && e.external > 0);
        CHECK_NEAR(e.error, 0, 0, 1e-9 * (e.external + e.elastic));
        peri_body_destroy(b);
    }
}

/* A solve that is given too few iterations fails, and what it has done to the body is accounted for. */
static void failed_solves_are_accounted_for(void) {
    const double force[2] = {1e-3, 3e-3};
    peri_solve_desc s;
    peri_energy e;
    peri_body *b = plate_of(PERI_LAW_LPS, 12, 5, PERI_GEOMETRY_LINEAR);
    MUST(b, peri_prescribe_displacement(b, part_of(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, part_of(b, 9, 12), force, NULL, NULL));
    peri_solve_desc_init(&s);
    s.preconditioner = PERI_PRECONDITIONER_NONE;
    s.iterations = 5;
    REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &s, NULL));
    MUST(b, peri_get_energy(b, &e));
    CHECK(e.elastic > 0); /* it has moved the body */
    CHECK_NEAR(e.error, 0, 0, 1e-10 * e.elastic);
    s.iterations = 20000;
    s.tolerance = 1e-30; /* no residual of doubles is as small */
    REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &s, NULL));
    CHECK(strcmp(seen.field, "tolerance") == 0);
    peri_body_destroy(b);
}

/* ---- contact ------------------------------------------------------------------------------------------------------- */

/* A plate that lies on a floor, held along it at one side: the floor bears its weight, and keeps it from turning. */
static void floors_bear_the_weight(void) {
    static const int32_t methods[2] = {PERI_METHOD_NEWTON, PERI_METHOD_BICGSTAB};
    int k, geometry;
    for (k = 0; k < 2; ++k)
        for (geometry = 0; geometry < 2; ++geometry) {
            const double weight[2] = {0, -1e-4}, place[2] = {0, 0.51}, up[2] = {0, 1};
            double force[2], side[2];
            peri_solve_desc s;
            peri_body *b = plate_of(PERI_LAW_BOND_BASED, 10, 4, geometry ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR);
            const int32_t wall = (int32_t)MUST(b, plane_obstacle(b, place, up, 1, NULL, NULL)); /* the lowest row is in it */
            const int32_t held = (int32_t)MUST(b, peri_prescribe_displacement(b, part_of(b, 0, 1), PERI_AXIS_X, NULL, NULL, NULL));
            MUST(b, peri_apply_body_force(b, PERI_ALL, weight, NULL, NULL));
            peri_solve_desc_init(&s);
            s.method = methods[k];
            MUST(b, peri_solve(b, &s, NULL));
            MUST(b, peri_get_obstacle_force(b, wall, force, NULL));
            CHECK_NEAR(force[1], 40e-4, 1e-6, 0);
            MUST(b, peri_get_reaction(b, held, side));
            CHECK_NEAR(side[0], 0, 0, 1e-9);
            peri_body_destroy(b);
        }
}

/* ---- parts --------------------------------------------------------------------------------------------------------- */

/* A point that has lost all its bonds is a part that can move along both axes, and cannot turn. */
static void single_points_have_two_motions(void) {
    const int32_t corner[1] = {39};
    const double force[2] = {1e-3, 0};
    int32_t pairs[64], n = 0, j;
    peri_solve_desc s;
    peri_solve_report r;
    peri_body *b = plate_of(PERI_LAW_BOND_BASED, 10, 4, PERI_GEOMETRY_LINEAR);
    for (j = 0; j < 39; ++j)
        if (peri_bond_is_intact(b, j, 39) == 1) {
            pairs[2 * n] = j;
            pairs[2 * n++ + 1] = corner[0];
        }
    CHECK(peri_cut_pairs(b, PERI_CUT_INITIAL, n, pairs) == n && n > 3);
    MUST(b, peri_prescribe_displacement(b, part_of(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, part_of(b, 7, 9), force, NULL, NULL));
    peri_solve_desc_init(&s);
    REFUSE(b, PERI_ERROR_LOOSE, peri_solve(b, &s, &r));
    CHECK(seen.index == 39 && seen.value == 2);
    s.loose = PERI_LOOSE_PINNED;
    MUST(b, peri_solve(b, &s, &r));
    CHECK(r.loose == 2);
    s.loose = PERI_LOOSE_BALANCED;
    MUST(b, peri_solve(b, &s, &r));
    CHECK(r.loose == 2);
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    CHECK(u[78] == 0 && u[79] == 0 && u[76] > 0);
    free(u);
    peri_body_destroy(b);
}

/* ---- fracture ------------------------------------------------------------------------------------------------------ */

/* "Between two materials: when either's criterion is met": the bonds between a half that never breaks and one that may. All points are
   held, the halves apart. */
static void either_material_may_break(void) {
    int soft_first;
    for (soft_first = 0; soft_first < 2; ++soft_first) {
        const double lo[2] = {0, 0}, middle[2] = {5, 4}, from[2] = {5, 0}, hi[2] = {10, 4}, apart[2] = {2, 0};
        peri_material_desc m;
        int32_t of[2];
        peri_solve_desc s;
        peri_solve_report r;
        int k, i, j;
        peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 2.2);
        for (k = 0; k < 2; ++k) {
            peri_material_desc_init(&m, PERI_LAW_LPS);
            m.young = m.density = 1;
            m.poisson = 0.2;
            if (k == !soft_first) m.critical_stretch = 0.01;
            of[k] = (int32_t)MUST(b, peri_add_material(b, &m));
        }
        MUST(b, peri_add_box(b, of[0], lo, middle, 1));
        MUST(b, peri_add_box(b, of[1], from, hi, 1));
        MUST(b, peri_build(b));
        MUST(b, peri_prescribe_displacement(b, part_of(b, 0, 5), PERI_AXIS_XY, NULL, NULL, NULL));
        MUST(b, peri_prescribe_displacement(b, part_of(b, 5, 10), PERI_AXIS_XY, apart, NULL, NULL));
        peri_solve_desc_init(&s);
        MUST(b, peri_solve(b, &s, &r));
        int crossing = 0;
        for (i = 0; i < 20; ++i)
            for (j = 20; j < 40; ++j)
                if (peri_bond_is_intact(b, i, j) >= 0) {
                    crossing++;
                    CHECK(peri_bond_is_intact(b, i, j) == 0 && peri_bond_is_intact(b, j, i) == 0);
                }
        CHECK(crossing > 8 && r.broken == crossing && peri_broken_count(b) == crossing);
        peri_body_destroy(b);
    }
}

/* Bonds that are pressed together break by no criterion, whatever the energy. */
static void pressure_breaks_nothing(void) {
    static const int32_t criteria[3] = {PERI_CRITERION_STRETCH, PERI_CRITERION_BOND_ENERGY, PERI_CRITERION_NODE_ENERGY};
    int k;
    for (k = 0; k < 3; ++k) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 2.2, 6, 6, 1);
        double u[72];
        peri_solve_desc d;
        peri_solve_report r;
        int i;
        s.material.criterion = criteria[k];
        s.material.fracture_energy = 1e-6;
        peri_body *b = specimen_make(&s);
        for (i = 0; i < 36; ++i) {
            const double x = i % 6 + 0.5, y = i / 6 + 0.5, to[2] = {-0.1 * x, -0.1 * y};
            const int32_t one[1] = {i};
            u[2 * i] = to[0];
            u[2 * i + 1] = to[1];
            MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, one)), PERI_AXIS_XY, to, NULL, NULL));
        }
        put(b, PERI_FIELD_DISPLACEMENT, u);
        peri_solve_desc_init(&d);
        MUST(b, peri_solve(b, &d, &r));
        CHECK(r.broken == 0 && peri_broken_count(b) == 0);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_ledger_closes);
    RUN(failed_solves_are_accounted_for);
    RUN(floors_bear_the_weight);
    RUN(single_points_have_two_motions);
    RUN(either_material_may_break);
    RUN(pressure_breaks_nothing);
    return test_end("test_survivors_loads");
}
