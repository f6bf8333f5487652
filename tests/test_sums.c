/* SPDX-License-Identifier: MIT */
/* test_sums.c - what adds up: a limit that one call keeps is not passed by several.

   SOURCE OF TRUTH: peri.h and docs/manual.md, with every sum restated here in double and in the units of the caller: a call is refused
   where the sum of all calls is beyond, the record names the field and the first point, and what was refused has changed nothing. Limits
   are 1e15 mean spacings (1e11 where cubes must fit into single precision), 1e9 sqrt(E/rho), and the largest number of the precision. */
#include "refusal.h"
#include <float.h>

enum { SIDE = 8, POINTS = SIDE * SIDE };

static peri_body *plate_of(int32_t law, int32_t precision, int32_t geometry) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, H, 3, SIDE, SIDE, 1);
    s.desc.precision = precision;
    s.desc.geometry = geometry;
    s.material.young = YOUNG;
    s.material.density = DENSITY;
    return specimen_make(&s);
}

/* The points from `first` on. */
static int32_t from(peri_body *b, int32_t first) {
    int32_t points[POINTS], k;
    for (k = first; k < POINTS; ++k) points[k - first] = k;
    return (int32_t)MUST(b, peri_select_points(b, NULL, POINTS - first, points));
}

/* All that the body says of its motion and what acts; forces are those of the last call that could make them. */
typedef struct snapshot {
    double      u[2 * POINTS], v[2 * POINTS], f[2 * POINTS], time, factor, step;
    peri_energy energy;
    int64_t     steps;
} snapshot;

static snapshot snap(peri_body *b, int forces) {
    snapshot s;
    memset(&s, 0, sizeof s);
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, s.u, 2 * POINTS));
    MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, s.v, 2 * POINTS));
    if (forces) MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, s.f, 2 * POINTS));
    MUST(b, peri_get_energy(b, &s.energy));
    s.time = peri_time(b);
    s.factor = peri_load_factor(b);
    s.step = peri_stable_step(b);
    s.steps = peri_step_count(b);
    return s;
}
static int same(const snapshot *a, const snapshot *b) { return memcmp(a, b, sizeof *a) == 0; }

/* ---- displacements and velocities -------------------------------------------------------------------------------------- */

static int32_t add(peri_body *b, int32_t field, int32_t set, const double *value) {
    return field == PERI_FIELD_VELOCITY ? peri_add_velocity(b, set, value) : peri_add_displacement(b, set, value);
}
static double limit_of(int32_t field, int32_t law, int32_t precision, int32_t geometry) {
    const int cubes = law == PERI_LAW_CORRESPONDENCE && precision != PERI_PRECISION_DOUBLE && geometry == PERI_GEOMETRY_NONLINEAR;
    return field == PERI_FIELD_VELOCITY ? 1e9 * sqrt(YOUNG / DENSITY) : (cubes ? 1e11 : 1e15) * H;
}

/* Forty calls at random, each within the limit by itself, of sets that overlap; sums are told from the limit to 1e-6. */
static void add_at_random(peri_body *b, int32_t field, double limit, uint64_t seed) {
    double sum[2 * POINTS] = {0}, got[2 * POINTS];
    int refused = 0, call, k;
    for (call = 0; call < 40; ++call) {
        const int32_t first = (int32_t)(test_random(&seed) * POINTS), set = first == 0 ? PERI_ALL : from(b, first);
        double value[2];
        int bad = -1, near = 0, status;
        for (k = 0; k < 2; ++k) value[k] = limit * (2 * test_random(&seed) - 1) * 0.99;
        for (k = 2 * POINTS - 1; k >= 2 * first; --k) {
            const double much = fabs(sum[k] + value[k % 2]) / limit;
            if (much >= 1) bad = k / 2;
            near |= fabs(much - 1) < 1e-6;
        }
        if (near) continue;
        status = add(b, field, set, value);
        if (bad >= 0) {
            peri_error e;
            CHECK(status == PERI_ERROR_RANGE && peri_get_error(b, &e) == PERI_OK);
            CHECK(strcmp(e.field, "value") == 0 && e.index == bad && fabs(e.value) >= limit * (1 - 1e-6));
            refused++;
        } else CHECK(MUST(b, status) == PERI_OK);
        for (k = 2 * first; bad < 0 && k < 2 * POINTS; ++k) sum[k] += value[k % 2];
        MUST(b, peri_get_field(b, field, got, 2 * POINTS));
        for (k = 0; k < 2 * POINTS; ++k) CHECK_NEAR(got[k], sum[k], 0, 1e-5 * limit);
        CHECK(MUST(b, peri_set_field(b, field, got, 2 * POINTS)) == PERI_OK); /* what may be reached may be set */
    }
    CHECK(refused > 5 && refused < 35);
}

static void states_by_many_calls(void) {
    static const int32_t fields[2] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY};
    int32_t law, precision, geometry;
    int k;
    for (law = PERI_LAW_BOND_BASED; law <= PERI_LAW_CORRESPONDENCE; law += PERI_LAW_CORRESPONDENCE - PERI_LAW_BOND_BASED)
        for (precision = PERI_PRECISION_DOUBLE; precision < peri__end_precision; ++precision)
            for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
                for (k = 0; k < 2; ++k) {
                    peri_body *b = plate_of(law, precision, geometry);
                    add_at_random(b, fields[k], limit_of(fields[k], law, precision, geometry), (uint64_t)(law + precision));
                    peri_body_destroy(b);
                }
}

/* The second of two calls is refused, at the first point that both move, and leaves the body as it was; the way back stays open. */
static void states_by_two_calls(void) {
    static const int32_t fields[2] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY};
    int k, axis;
    for (k = 0; k < 2; ++k)
        for (axis = 0; axis < 2; ++axis) {
            peri_body *b = plate_of(PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR);
            const double limit = limit_of(fields[k], PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR);
            double part[2] = {0, 0}, less[2] = {0, 0};
            snapshot before, after;
            part[axis] = 0.9 * limit;
            less[axis] = -0.9 * limit;
            MUST(b, add(b, fields[k], from(b, 40), part));
            before = snap(b, 1);
            REFUSE(b, PERI_ERROR_RANGE, add(b, fields[k], from(b, 20), part));
            FIELD_IS("value");
            CHECK(seen.index == 40);
            CHECK_NEAR(seen.value, 1.8 * limit, 1e-12, 0);
            after = snap(b, 1);
            CHECK(same(&before, &after));
            MUST(b, add(b, fields[k], PERI_ALL, less));
            peri_body_destroy(b);
        }
}

/* In single precision a number below the limit may be one at the limit when it is stored: where the motion begins with what is refused. */
static void states_that_single_rounds_up(void) {
    peri_body *b = plate_of(PERI_LAW_BOND_BASED, PERI_PRECISION_SINGLE, PERI_GEOMETRY_LINEAR);
    const double limit = 1e9 * sqrt(YOUNG / DENSITY), value[2] = {limit * (1 - 1e-9), 0};
    double v[2 * POINTS] = {0};
    v[10] = value[0];
    REFUSE(b, PERI_ERROR_RANGE, peri_add_velocity(b, PERI_ALL, value));
    REFUSE(b, PERI_ERROR_RANGE, peri_set_field(b, PERI_FIELD_VELOCITY, v, 2 * POINTS));
    CHECK(seen.index == 5);
    v[10] = limit * (1 - 2e-7);
    MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, 2 * POINTS));
    peri_body_destroy(b);
}

/* ---- what motion adds up ----------------------------------------------------------------------------------------------- */

/* The manual: no limit ends a motion but that of velocities, and numbers that are none. A point that has gone further than 1e15 spacings
   cannot be set there, nor moved on; only back. */
static void displacements_by_motion(void) {
    const double fast[2] = {0.9e9 * sqrt(YOUNG / DENSITY), 0}, far[2] = {0.9999e15 * H, 0}, back[2] = {-0.5e15 * H, 0}, none[2] = {0, 0};
    peri_body *b = plate_of(PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR);
    double u[2 * POINTS];
    MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_XY, fast, NULL, NULL));
    MUST(b, peri_add_displacement(b, PERI_ALL, far));
    go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 300, 0, 0);
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * POINTS));
    CHECK(u[0] > 1e15 * H);
    CHECK_NEAR(u[0], far[0] + fast[0] * peri_time(b), 1e-6, 0);
    REFUSE(b, PERI_ERROR_RANGE, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * POINTS));
    REFUSE(b, PERI_ERROR_RANGE, peri_add_displacement(b, PERI_ALL, none));
    MUST(b, peri_add_displacement(b, PERI_ALL, back));
    go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0, 0);
    peri_body_destroy(b);
}

/* A support times the load factor, in one step and in equilibrium: the speed that it takes has a limit, the way has none. */
static void supports_by_the_load_factor(void) {
    int factor, integrator;
    for (integrator = PERI_INTEGRATOR_VELOCITY_VERLET; integrator < peri__end_integrator; ++integrator)
        for (factor = 1; factor <= 2; ++factor) {
            peri_body *b = plate_of(PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR);
            const double dt = 0.9 * peri_stable_step(b), way[2] = {0, 0.6e9 * sqrt(YOUNG / DENSITY) * dt}, far[2] = {0.6e15 * H, 0};
            peri_advance_desc r;
            peri_solve_desc s;
            double u[2 * POINTS];
            MUST(b, peri_prescribe_displacement(b, from(b, 40), PERI_AXIS_Y, way, NULL, NULL));
            peri_advance_desc_init(&r);
            r.integrator = integrator;
            r.time_step = dt;
            r.steps = 1;
            r.load_factor = factor;
            if (factor == 2) {
                REFUSE(b, PERI_ERROR_UNSTABLE, peri_advance(b, &r));
                CHECK(seen.index == 40);
            } else MUST(b, peri_advance(b, &r));
            MUST(b, peri_reset(b));
            MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, far, NULL, NULL));
            peri_solve_desc_init(&s);
            s.load_to = factor;
            MUST(b, peri_solve(b, &s, NULL));
            MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * POINTS));
            CHECK_NEAR(u[0], factor * far[0], 1e-12, 0);
            if (factor == 2) REFUSE(b, PERI_ERROR_RANGE, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * POINTS));
            else MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * POINTS));
            peri_body_destroy(b);
        }
}

/* Newton's second law: under the acceleration a the n-th step ends at n a dt. The first whose velocity is no longer below the limit
   fails. */
static void velocities_by_motion(void) {
    int32_t precision;
    for (precision = PERI_PRECISION_DOUBLE; precision < peri__end_precision; ++precision) {
        peri_body *b = plate_of(PERI_LAW_BOND_BASED, precision, PERI_GEOMETRY_LINEAR);
        const double dt = 0.9 * peri_stable_step(b), limit = 1e9 * sqrt(YOUNG / DENSITY);
        const double force[2] = {0, -DENSITY * limit / (10.5 * dt)}; /* 10.5 steps */
        peri_advance_desc r;
        MUST(b, peri_apply_body_force(b, from(b, 0), force, NULL, NULL));
        peri_advance_desc_init(&r);
        r.time_step = dt;
        r.steps = 10;
        MUST(b, peri_advance(b, &r));
        REFUSE(b, PERI_ERROR_UNSTABLE, peri_advance(b, &r));
        CHECK(seen.index == 0 && peri_step_count(b) == 11);
        CHECK_NEAR(seen.value, 11 * dt, 1e-6, 0);
        peri_body_destroy(b);
    }
}

/* ---- forces ------------------------------------------------------------------------------------------------------------ */

/* The largest force density of a precision: in single it is kept over young/spacing; in double what is told must be a number, too. */
static double largest_force(int32_t precision) { return precision == PERI_PRECISION_SINGLE ? FLT_MAX * YOUNG / H : DBL_MAX; }

enum adding { TWO_LOADS, TWO_TRACTIONS, LOAD_AND_OBSTACLE, TWO_OBSTACLES, FACTOR, ADDINGS };

/* Something that pushes point 30 and those after it to the right by 0.9 of the most that there is; -1: the load factor. */
static int32_t push(peri_body *b, int adding, int second, double most, double *factor) {
    const double value[2] = {0.9 * most, 0}, right[2] = {1, 0}, deep = 1e10, place[2] = {deep, 0};
    const int obstacle = (adding == LOAD_AND_OBSTACLE && second) || adding == TWO_OBSTACLES;
    double volume = (POINTS - 30) * H * H;
    *factor = 1;
    if (obstacle) return plane_obstacle(b, place, right, 0.9 * most / deep, NULL, NULL);
    if (adding == FACTOR && second) return *factor = 2, -1;
    if (adding == TWO_TRACTIONS) return peri_apply_layer_traction(b, from(b, 30), volume, value, NULL, NULL);
    return peri_apply_body_force(b, from(b, second ? 20 : 30), value, NULL, NULL);
}

/* Every call that takes forces says that they are beyond the precision, and where first; without the second all is as before. */
static void forces_beyond(int adding, int32_t precision) {
    peri_body *b = plate_of(PERI_LAW_BOND_BASED, precision, PERI_GEOMETRY_LINEAR);
    const int obstacle = adding == LOAD_AND_OBSTACLE || adding == TWO_OBSTACLES;
    const double most = largest_force(precision);
    double f[2 * POINTS], factor;
    int32_t id;
    peri_view view;
    peri_advance_desc r;
    peri_solve_desc s;
    snapshot before, after;
    const int64_t first = adding == TWO_OBSTACLES ? 0 : 30;
    MUST(b, push(b, adding, 0, most, &factor));
    before = snap(b, 1);
    id = push(b, adding, 1, most, &factor);
    peri_advance_desc_init(&r);
    r.steps = 1;
    r.load_factor = factor;
    peri_solve_desc_init(&s);
    s.load_from = s.load_to = factor;
    s.loose = PERI_LOOSE_BALANCED;
    if (adding != FACTOR) {
        MUST(b, id);
        REFUSE(b, PERI_ERROR_RANGE, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 2 * POINTS));
        FIELD_IS(obstacle ? "stiffness" : "value");
        CHECK(seen.index == first && !(fabs(seen.value) < most));
        REFUSE(b, PERI_ERROR_RANGE, peri_get_field(b, PERI_FIELD_REACTION, f, 2 * POINTS));
        REFUSE(b, PERI_ERROR_RANGE, peri_view_field(b, PERI_FIELD_FORCE_DENSITY, &view));
        if (adding != TWO_OBSTACLES) REFUSE(b, PERI_ERROR_RANGE, peri_get_reaction(b, peri_id(b, PERI_KIND_LOAD, 1), f));
        if (obstacle) REFUSE(b, PERI_ERROR_RANGE, peri_get_obstacle_force(b, id, f, NULL));
    }
    REFUSE(b, PERI_ERROR_RANGE, peri_solve(b, &s, NULL));
    MUST(b, peri_reset(b));
    REFUSE(b, PERI_ERROR_RANGE, peri_advance(b, &r));
    FIELD_IS(obstacle ? "stiffness" : "value");
    CHECK(seen.index == first);
    if (adding != FACTOR) MUST(b, obstacle ? peri_remove_obstacle(b, id) : peri_remove_load(b, id));
    MUST(b, peri_reset(b));
    after = snap(b, 1);
    CHECK(same(&before, &after));
    peri_body_destroy(b);
}
static void forces_by_two(void) {
    int adding;
    int32_t precision;
    for (adding = 0; adding < ADDINGS; ++adding)
        for (precision = PERI_PRECISION_DOUBLE; precision < peri__end_precision; ++precision) forces_beyond(adding, precision);
}

/* Force densities that are all within double, of points whose total is not. */
static void totals_of_forces(void) {
    const double value[2] = {0, 0.5 * DBL_MAX}, up[2] = {0, 1}, place[2] = {0, 1e10};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3, SIDE, SIDE, 1);
    peri_body *b = specimen_make(&s);
    double f[2 * POINTS], total[2] = {7, 7};
    int32_t wall;
    const int32_t sum = (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, value, NULL, NULL));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 2 * POINTS));
    CHECK(f[1] == value[1]);
    REFUSE(b, PERI_ERROR_RANGE, peri_get_reaction(b, sum, total));
    FIELD_IS("force");
    CHECK(seen.value == HUGE_VAL && total[0] == 7 && total[1] == 7);
    MUST(b, peri_remove_load(b, sum));
    wall = (int32_t)MUST(b, plane_obstacle(b, place, up, 0.5 * DBL_MAX / 1e10, NULL, NULL));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 2 * POINTS));
    CHECK_NEAR(f[1], value[1], 1e-8, 0);
    REFUSE(b, PERI_ERROR_RANGE, peri_get_obstacle_force(b, wall, total, NULL));
    CHECK(total[0] == 7 && total[1] == 7);
    peri_body_destroy(b);
}

/* ---- what else adds up ------------------------------------------------------------------------------------------------- */

/* Both factors are numbers, the way between them is none. */
static void factors_that_are_too_far_apart(void) {
    const double value[2] = {1e-3, 0};
    peri_body *b = plate_of(PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR);
    peri_solve_desc s;
    snapshot before, after;
    MUST(b, peri_apply_body_force(b, PERI_ALL, value, NULL, NULL));
    go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0, 0);
    before = snap(b, 1);
    peri_solve_desc_init(&s);
    s.load_from = -0.9 * DBL_MAX;
    s.load_to = 0.9 * DBL_MAX;
    s.steps = 2;
    REFUSE(b, PERI_ERROR_RANGE, peri_solve(b, &s, NULL));
    FIELD_IS("load_to");
    CHECK(seen.value == s.load_to);
    after = snap(b, 1);
    CHECK(same(&before, &after));
    peri_body_destroy(b);
}

/* Stiffness over the least density adds up in the bound of the stable step, 2/sqrt(row sum + sum of stiffness/density)
   (docs/theory.md): what alone would leave none is refused. */
static void stiffness_of_obstacles(void) {
    const double place[2] = {0, -1}, up[2] = {0, 1}, heavy = 1e6, light = 1e-3;
    peri_body_desc d;
    peri_body *b = NULL;
    int k;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3;
    CHECK(peri_body_create(&d, &b, NULL) == PERI_OK);
    for (k = 0; k < 2; ++k) {
        const double lo[2] = {8 * k, 0}, hi[2] = {8 * k + 8, 8};
        MUST(b, peri_add_box(b, unbreakable(b, 1, k ? light : heavy), lo, hi, 1));
    }
    MUST(b, peri_build(b));
    REFUSE(b, PERI_ERROR_RANGE, plane_obstacle(b, place, up, 1e308 * light, NULL, NULL));
    FIELD_IS("stiffness");
    CHECK(seen.value == 1e308 * light && peri_id(b, PERI_KIND_OBSTACLE, 1) == PERI_ERROR_ID_GONE);
    for (k = 1; k <= 4; ++k) {
        MUST(b, plane_obstacle(b, place, up, 1e290 * light, NULL, NULL));
        CHECK_NEAR(peri_stable_step(b), 2 / sqrt(k * 1e290), 1e-9, 0);
    }
    peri_body_destroy(b);
}

/* 2^31 - 65 points, less those that there are. */
static void points(void) {
    const double lo[2] = {0, 0}, hi[2] = {300, 300}, wide[2] = {46340, 46340};
    peri_body_desc d;
    peri_body *b;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 2;
    b = test_unit_body(&d, 0);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    REFUSE(b, PERI_ERROR_TOO_LARGE, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, wide, 1)); /* which alone may be */
    FIELD_IS("points");
    CHECK(peri_point_count(b) == 90000);
    peri_body_destroy(b);
}

static int32_t one_more(peri_body *b, int32_t kind) {
    const double place[2] = {0, -1}, up[2] = {0, 1}, none[2] = {0, 0};
    const int32_t point = 0;
    if (kind == PERI_KIND_SET) return peri_select_points(b, NULL, 1, &point);
    return kind == PERI_KIND_LOAD ? peri_apply_body_force(b, PERI_ALL, none, NULL, NULL)
                                  : plane_obstacle(b, place, up, 1, NULL, NULL);
}

/* 1,048,575 of a kind (PERI_ID_INDEX has 20 bits), removed ones included. */
static void ids_of(int32_t kind) {
    const int64_t most = 0xFFFFF;
    peri_body *b = plate_of(PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR);
    int64_t k = 0;
    while (k < most && one_more(b, kind) > 0) ++k;
    CHECK(k == most);
    REFUSE(b, PERI_ERROR_TOO_LARGE, one_more(b, kind));
    CHECK(seen.value == (double)most);
    CHECK(PERI_ID_INDEX(peri_id(b, kind, most)) == most && peri_id(b, kind, most + 1) == PERI_ERROR_ID_GONE);
    if (kind == PERI_KIND_LOAD) MUST(b, peri_remove_load(b, peri_id(b, kind, most)));
    if (kind == PERI_KIND_OBSTACLE) MUST(b, peri_remove_obstacle(b, peri_id(b, kind, most)));
    REFUSE(b, PERI_ERROR_TOO_LARGE, one_more(b, kind));
    peri_body_destroy(b);
}
static void ids_of_sets(void) { ids_of(PERI_KIND_SET); }
static void ids_of_loads_and_obstacles(void) { /* half a gigabyte */
    ids_of(PERI_KIND_LOAD);
    ids_of(PERI_KIND_OBSTACLE);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(states_by_many_calls);
    RUN(states_by_two_calls);
    RUN(states_that_single_rounds_up);
    RUN(displacements_by_motion);
    RUN(supports_by_the_load_factor);
    RUN(velocities_by_motion);
    RUN(forces_by_two);
    RUN(totals_of_forces);
    RUN(factors_that_are_too_far_apart);
    RUN(stiffness_of_obstacles);
    RUN(points);
    RUN(ids_of_sets);
    LONG_RUN(ids_of_loads_and_obstacles);
    return test_end("test_sums");
}
