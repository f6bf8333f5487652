/* SPDX-License-Identifier: MIT */
/* test_promises_runs.c - sentences of docs/manual.md on motion, supports, loads and what depends on history that no other test is about.
   tests/promises says which sentence each case proves. SOURCE OF TRUTH: that sentence, quoted before each case; Newton's laws. */
#include "refusal.h"

static const double lo2[2] = {0, 0};

static specimen plate_of(int32_t law, int nx, int ny) { return specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 2.1, nx, ny, 1); }
static peri_body *plate(int nx, int ny) {
    const specimen s = plate_of(PERI_LAW_BOND_BASED, nx, ny);
    return specimen_make(&s);
}
static int32_t columns(peri_body *b, double from, double to) {
    const double lo[2] = {from, -99}, hi[2] = {to, 99};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}
static int32_t run(peri_body *b, int64_t steps, double time_step, double load_factor) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = steps;
    a.time_step = time_step;
    a.load_factor = load_factor;
    return peri_advance(b, &a);
}
static double first_of(peri_body *b, int32_t field, int64_t at) {
    double *x = get(b, field), value = x[at];
    free(x);
    return value;
}

/* ---- bonds and parts ----------------------------------------------------------------------------------------------- */

/* u = stretch x along x, at rest, and a step so short that nothing moves. */
static void stretch_once(peri_body *b, double stretch) {
    double *x = get(b, PERI_FIELD_POSITION), *rest = random_field(peri_size_of_field(b, PERI_FIELD_VELOCITY), 0, 1);
    for (int64_t k = 0; k < peri_size_of_field(b, PERI_FIELD_POSITION); ++k) x[k] *= k % 2 ? 0 : stretch;
    put(b, PERI_FIELD_DISPLACEMENT, x);
    put(b, PERI_FIELD_VELOCITY, rest);
    MUST(b, run(b, 1, 1e-9, (double)NAN));
    free(x);
    free(rest);
}
/* "A bond that is stretched too far breaks and stays broken": of every law and criterion, when the points are back in their places, and
   pressed together, too. */
static void broken_bonds_stay_broken(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (int32_t criterion = PERI_CRITERION_STRETCH; criterion <= PERI_CRITERION_NODE_ENERGY; ++criterion) {
            specimen s = plate_of(law, 8, 6);
            if (law == PERI_LAW_BOND_BASED && criterion != PERI_CRITERION_STRETCH) continue;
            s.material.criterion = criterion;
            if (criterion == PERI_CRITERION_STRETCH) s.material.critical_stretch = 0.01;
            else s.material.fracture_energy = 1e-4;
            peri_body *b = specimen_make(&s);
            stretch_once(b, 1e-5);
            CHECK(peri_broken_count(b) == 0);
            stretch_once(b, 0.1);
            const int64_t broken = peri_broken_count(b);
            double *damage = get(b, PERI_FIELD_DAMAGE), *after;
            CHECK(broken > 20);
            stretch_once(b, 0);
            stretch_once(b, -1e-3);
            after = get(b, PERI_FIELD_DAMAGE);
            CHECK(peri_broken_count(b) == broken && memcmp(damage, after, 48 * sizeof *after) == 0);
            free(damage);
            free(after);
            peri_body_destroy(b);
        }
}

/* Parts of a body touch only where that is declared: two blocks, farther apart than a horizon, thrown at each other, end on the other side
   with the velocities that they had. */
static void parts_pass_through_each_other(void) {
    const specimen s = plate_of(PERI_LAW_BOND_BASED, 4, 4);
    const double lo[2] = {8, 0}, hi[2] = {12, 4}, right[2] = {0.5, 0}, left[2] = {-0.5, 0};
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1));
    MUST(b, peri_build(b));
    MUST(b, peri_add_velocity(b, columns(b, 0, 4), right));
    MUST(b, peri_add_velocity(b, columns(b, 8, 12), left));
    MUST(b, run(b, 100, 0.3, (double)NAN)); /* each goes 15 spacings */
    double *v = get(b, PERI_FIELD_VELOCITY), *x = get(b, PERI_FIELD_CURRENT_POSITION);
    for (int64_t i = 0; i < 32; ++i) {
        CHECK_NEAR(v[2 * i], i < 16 ? 0.5 : -0.5, 1e-12, 0);
        CHECK(fabs(v[2 * i + 1]) < 1e-13 && (i < 16 ? x[2 * i] > 14 : x[2 * i] < -2));
    }
    free(v);
    free(x);
    peri_body_destroy(b);
}

/* ---- load factors, supports, loads --------------------------------------------------------------------------------- */

static int32_t keep_or_write(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)time, (void)points;
    for (int64_t k = 0; k < count; ++k) {
        CHECK(value[2 * k] == 1e-3); /* "the constant value at entry, without the load factor" */
        if (*(int *)user) value[2 * k] = 5e-3;
    }
    return 0;
}
/* "peri_solve [starts] at 0 and peri_advance at 1 where no load has acted yet. So after a solve to half the load a run goes on at half.
   Give load_from or load_factor to decide." "The load factor multiplies a constant displacement, not a constant velocity; in peri_solve
   prescribed velocities hold a point where it is." peri_load_fn: "what you leave stands, what you overwrite counts, and the load factor
   does not multiply it". load_factor "multiplies constant values for this run and after it". peri_reset: load factor becomes zero. */
static void load_factors(void) {
    const double f0[2] = {1e-3, 0}, moved[2] = {0, 1e-3}, still[2] = {0, 0}, fast[2] = {2e-3, 0};
    double force[2];
    int writes = 0;
    peri_solve_desc s;
    peri_body *b = plate(10, 6);
    MUST(b, peri_prescribe_displacement(b, columns(b, 0, 2), PERI_AXIS_XY, still, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, columns(b, 8, 10), PERI_AXIS_Y, moved, NULL, NULL));
    MUST(b, peri_prescribe_velocity(b, columns(b, 4, 5), PERI_AXIS_X, fast, NULL, NULL));
    const int32_t plain = (int32_t)MUST(b, peri_apply_body_force(b, columns(b, 6, 7), f0, NULL, NULL)); /* 6 cells */
    const int32_t asked = (int32_t)MUST(b, peri_apply_body_force(b, columns(b, 6, 7), f0, keep_or_write, &writes));
#define TOTALS(of_plain, of_asked)                                                                                     \
    do {                                                                                                               \
        MUST(b, peri_get_reaction(b, plain, force));                                                                   \
        CHECK_NEAR(force[0], 6 * (of_plain), 1e-13, 0);                                                                \
        MUST(b, peri_get_reaction(b, asked, force));                                                                   \
        CHECK_NEAR(force[0], 6 * (of_asked), 1e-13, 0);                                                                \
    } while (0)
    CHECK(peri_load_factor(b) == 0);
    MUST(b, run(b, 1, 0.1, (double)NAN)); /* at 1 */
    CHECK(peri_load_factor(b) == 1);
    TOTALS(1e-3, 1e-3);
    CHECK_NEAR(first_of(b, PERI_FIELD_DISPLACEMENT, 2 * 9 + 1), 1e-3, 1e-13, 0);
    CHECK_NEAR(first_of(b, PERI_FIELD_VELOCITY, 2 * 4), 2e-3, 1e-13, 0);
    MUST(b, peri_reset(b));
    CHECK(peri_load_factor(b) == 0);
    peri_solve_desc_init(&s);
    s.steps = 2;
    s.load_to = 0.5;
    MUST(b, peri_solve(b, &s, NULL)); /* from 0 */
    CHECK(peri_load_factor(b) == 0.5);
    TOTALS(0.5e-3, 1e-3); /* what is left to the callback stands: the constant, not multiplied */
    CHECK_NEAR(first_of(b, PERI_FIELD_DISPLACEMENT, 2 * 9 + 1), 0.5e-3, 1e-13, 0);
    CHECK(first_of(b, PERI_FIELD_DISPLACEMENT, 2 * 4) == 0); /* held where it is */
    MUST(b, run(b, 1, 0.1, (double)NAN)); /* goes on at half */
    CHECK(peri_load_factor(b) == 0.5);
    TOTALS(0.5e-3, 1e-3);
    CHECK_NEAR(first_of(b, PERI_FIELD_VELOCITY, 2 * 4), 2e-3, 1e-13, 0); /* a velocity is not multiplied */
    writes = 1;
    MUST(b, run(b, 1, 0.1, 0.25));
    TOTALS(0.25e-3, 5e-3);
    CHECK_NEAR(first_of(b, PERI_FIELD_DISPLACEMENT, 2 * 9 + 1), 0.25e-3, 1e-13, 0);
    MUST(b, run(b, 1, 0.1, (double)NAN)); /* "and after it" */
    CHECK(peri_load_factor(b) == 0.25);
    s.steps = 1;
    s.load_from = 0;
    s.load_to = 1;
    MUST(b, peri_solve(b, &s, NULL));
    CHECK(peri_load_factor(b) == 1);
    peri_body_destroy(b);
}

static int32_t ramp(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)points;
    for (int64_t k = 0; k < count; ++k) value[2 * k] = *(const double *)user * time * time;
    return 0;
}
/* "reaction of a support: ... before any step, what holds the present state": bonds pull the held column by what the rest of the body
   lacks. */
static void reactions_before_a_step(void) {
    peri_body *b = plate(8, 4);
    double *u = random_field(64, 1e-3, 5), force[2], sum[2] = {0, 0};
    put(b, PERI_FIELD_DISPLACEMENT, u);
    double *f = get(b, PERI_FIELD_FORCE_DENSITY);
    for (int64_t i = 0; i < 32; ++i)
        for (int d = 0; d < 2; ++d) sum[d] -= i % 8 == 0 ? f[2 * i + d] : 0;
    const int32_t support = (int32_t)MUST(b, peri_prescribe_velocity(b, columns(b, 0, 1), PERI_AXIS_X, NULL, NULL, NULL));
    MUST(b, peri_get_reaction(b, support, force));
    CHECK_NEAR(force[0], sum[0], 1e-12, 0);
    CHECK(force[0] != 0 && force[1] == 0);
    free(u);
    free(f);
    peri_body_destroy(b);
}
/* "velocity where displacement is prescribed: the last step: it is the mean of it": (a t2^2 - a t1^2)/(t2 - t1). */
static void velocity_of_a_prescribed_displacement(void) {
    double a = 1e-3, before;
    peri_body *b = plate(8, 4);
    MUST(b, peri_prescribe_displacement(b, columns(b, 0, 1), PERI_AXIS_X, NULL, ramp, &a));
    for (int k = 0; k < 3; ++k) {
        before = peri_time(b);
        MUST(b, run(b, 1, 0.1 * (k + 1), (double)NAN));
        CHECK_NEAR(first_of(b, PERI_FIELD_VELOCITY, 0), a * (peri_time(b) + before), 1e-12, 0);
    }
    peri_body_destroy(b);
}
/* "which support owns a component of a point: later ones win. When one is removed the component falls back to the one before." */
static void supports_fall_back(void) {
    const double one[2] = {0.01, 0.01}, two[2] = {0.02, 0}, three[2] = {0.03, 0};
    int32_t load[3];
    peri_body *b = plate(8, 4);
    load[0] = (int32_t)MUST(b, peri_prescribe_displacement(b, columns(b, 0, 2), PERI_AXIS_XY, one, NULL, NULL));
    load[1] = (int32_t)MUST(b, peri_prescribe_displacement(b, columns(b, 0, 1), PERI_AXIS_X, two, NULL, NULL));
    load[2] = (int32_t)MUST(b, peri_prescribe_displacement(b, columns(b, 0, 1), PERI_AXIS_X, three, NULL, NULL));
#define STANDS(x, y)                                                                                                   \
    do {                                                                                                               \
        MUST(b, run(b, 1, 0.1, (double)NAN));                                                                          \
        CHECK_NEAR(first_of(b, PERI_FIELD_DISPLACEMENT, 0), x, 1e-13, 0);                                              \
        CHECK_NEAR(first_of(b, PERI_FIELD_DISPLACEMENT, 1), y, 1e-13, 0);                                              \
    } while (0)
    STANDS(0.03, 0.01);
    MUST(b, peri_remove_load(b, load[1]));
    STANDS(0.03, 0.01);
    MUST(b, peri_remove_load(b, load[2]));
    STANDS(0.01, 0.01);
    MUST(b, peri_remove_load(b, load[0]));
    MUST(b, run(b, 1, 0.1, (double)NAN));
    CHECK(fabs(first_of(b, PERI_FIELD_DISPLACEMENT, 0) - 0.01) > 1e-5); /* free */
    peri_body_destroy(b);
}
/* "tractions and pressures: the bonds at the call: cracks made later do not change them": the load as read on the points, before and
   after a crack along the face. */
static void tractions_keep_their_bonds(void) {
    const double normal[2] = {1, 0}, pull[2] = {1e-3, 0}, from[2] = {10.5, -1}, to[2] = {10.5, 4};
    for (int kind = 0; kind < 2; ++kind) {
        specimen s = plate_of(PERI_LAW_CORRESPONDENCE, 12, 6);
        peri_body *b[2];
        double *f[3];
        for (int k = 0; k < 2; ++k) {
            b[k] = specimen_make(&s);
            const int32_t face = columns(b[k], 6, 12);
            if (k == 0) MUST(b[k], kind ? peri_apply_pressure(b[k], face, 1e-3, NULL, NULL)
                                        : peri_apply_traction(b[k], face, 6, normal, pull, NULL, NULL));
            if (k == 0) f[0] = get(b[k], PERI_FIELD_FORCE_DENSITY);
            CHECK(MUST(b[k], peri_cut_segment(b[k], PERI_CUT_NOW, from, to)) > 10);
            if (k == 1) MUST(b[k], kind ? peri_apply_pressure(b[k], face, 1e-3, NULL, NULL)
                                        : peri_apply_traction(b[k], face, 6, normal, pull, NULL, NULL));
            MUST(b[k], peri_add_displacement(b[k], PERI_ALL, lo2));
            f[k + 1] = get(b[k], PERI_FIELD_FORCE_DENSITY);
        }
        const double most = largest(f[0], 144);
        CHECK(most > 1e-4);
        double apart = 0, other = 0;
        for (int64_t i = 0; i < 144; ++i) apart = fmax(apart, fabs(f[1][i] - f[0][i])), other = fmax(other, fabs(f[2][i] - f[0][i]));
        CHECK(apart <= 1e-14 * most && other > 1e-2 * most); /* after the crack the same call gives another load */
        for (int k = 0; k < 3; ++k) free(f[k]);
        peri_body_destroy(b[0]);
        peri_body_destroy(b[1]);
    }
}
/* peri_prescribe_displacement, _velocity: "NULL for `value` is zero. value[d] of axes that are not prescribed is not used": it may be
   NaN. */
static void null_prescribes_zero(void) {
    const double v[2] = {0.1, 0.2}, odd[2] = {(double)NAN, 0.05};
    peri_body *b = plate(8, 4);
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    MUST(b, peri_prescribe_velocity(b, columns(b, 0, 1), PERI_AXIS_X, NULL, NULL, NULL));
    MUST(b, peri_prescribe_velocity(b, columns(b, 0, 1), PERI_AXIS_Y, odd, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, columns(b, 7, 8), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, run(b, 1, 0.1, (double)NAN));
    CHECK(first_of(b, PERI_FIELD_VELOCITY, 0) == 0 && fabs(first_of(b, PERI_FIELD_VELOCITY, 1) - 0.05) < 1e-15);
    CHECK(first_of(b, PERI_FIELD_DISPLACEMENT, 14) == 0 && first_of(b, PERI_FIELD_DISPLACEMENT, 15) == 0);
    peri_body_destroy(b);
}
/* "of state-based laws two [horizons]: their points feel what moves two horizons away", bond-based ones what moves one away: a row of cells
   of which the first is moved; the horizon is 2 spacings. */
static void reach_of_a_grip(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        const double moved[2] = {1e-3, 0};
        specimen s = plate_of(law, 12, 3);
        s.desc.horizon = 2;
        peri_body *b = specimen_make(&s);
        const double unit = micromodulus(PERI_SPACE_PLANE_STRESS, 1, 2) * 1e-3;
        int reach = 0;
        MUST(b, peri_add_displacement(b, columns(b, 0, 1), moved));
        double *f = get(b, PERI_FIELD_FORCE_DENSITY);
        for (int at = 0; at < 12; ++at)
            if (fabs(f[2 * (12 + at)]) > 1e-12 * unit) reach = at;
        CHECK(reach == (law == PERI_LAW_BOND_BASED ? 2 : 4));
        free(f);
        peri_body_destroy(b);
    }
}
/* "peri_remove_load: loads and supports; ids of the others stay"; peri_get_reaction: "of a support the force on the body in its prescribed
   components, of a load its present total". */
static void removed_loads(void) {
    const double f0[2] = {1e-3, 2e-3};
    double force[2];
    int32_t load[3];
    peri_body *b = plate(8, 4);
    for (int k = 0; k < 3; ++k) load[k] = (int32_t)MUST(b, peri_apply_body_force(b, columns(b, 0, k + 1), f0, NULL, NULL));
    const int32_t support = (int32_t)MUST(b, peri_prescribe_velocity(b, columns(b, 7, 8), PERI_AXIS_Y, NULL, NULL, NULL));
    MUST(b, peri_remove_load(b, load[0]));
    for (int k = 1; k < 3; ++k) {
        MUST(b, peri_get_reaction(b, load[k], force));
        CHECK_NEAR(force[1], 4 * (k + 1) * 2e-3, 1e-13, 0);
    }
    MUST(b, run(b, 5, 0.3, (double)NAN));
    MUST(b, peri_get_reaction(b, support, force));
    CHECK(force[0] == 0 && force[1] != 0);
    MUST(b, peri_remove_load(b, support));
    REFUSE(b, PERI_ERROR_ID_GONE, peri_get_reaction(b, support, force));
    peri_body_destroy(b);
}
/* peri_add_displacement, peri_add_velocity: "now, once; they add up". */
static void starts_add_up(void) {
    const double one[2] = {0.25, -0.5}, two[2] = {0.125, 1};
    peri_body *b = plate(8, 4);
    MUST(b, peri_add_displacement(b, PERI_ALL, one));
    MUST(b, peri_add_displacement(b, columns(b, 0, 1), two));
    MUST(b, peri_add_velocity(b, PERI_ALL, one));
    MUST(b, peri_add_velocity(b, PERI_ALL, two));
    CHECK(first_of(b, PERI_FIELD_DISPLACEMENT, 0) == 0.375 && first_of(b, PERI_FIELD_DISPLACEMENT, 1) == 0.5);
    CHECK(first_of(b, PERI_FIELD_DISPLACEMENT, 2) == 0.25 && first_of(b, PERI_FIELD_VELOCITY, 3) == 0.5);
    MUST(b, peri_reset(b));
    CHECK(first_of(b, PERI_FIELD_DISPLACEMENT, 0) == 0 && first_of(b, PERI_FIELD_VELOCITY, 0) == 0);
    peri_body_destroy(b);
}
/* Obstacles: "stiffness 0 takes young/spacing^2 of the stiffest material": of three, of which one is stiffer and has no points. */
static void stiffest_material_of_an_obstacle(void) {
    const double lo[2] = {20, 0}, hi[2] = {24, 4}, place[2] = {0, 0.75}, up[2] = {0, 1};
    specimen s = plate_of(PERI_LAW_BOND_BASED, 4, 4);
    double force[2];
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    s.material.young = 7;
    MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &s.material)), lo, hi, 1));
    s.material.young = 1000;
    MUST(b, peri_add_material(b, &s.material));
    MUST(b, peri_build(b));
    const int32_t plane = (int32_t)MUST(b, plane_obstacle(b, place, up, 0, NULL, NULL));
    MUST(b, peri_get_obstacle_force(b, plane, force, NULL));
    CHECK_NEAR(force[1], 8 * 0.25 * 7, 1e-13, 0); /* 8 points of both blocks are 0.25 inside */
    peri_body_destroy(b);
}

/* ---- history ------------------------------------------------------------------------------------------------------- */

typedef struct path { /* strains ex, ey to size, one after the other */
    const double *x;
    int           y_first;
    double        size;
} path;
static int32_t strain_on(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const path *p = (const path *)user;
    const double first = p->size * fmin(time, 1), second = p->size * fmax(time - 1, 0);
    for (int64_t k = 0; k < count; ++k) {
        value[2 * k] = (p->y_first ? second : first) * p->x[2 * points[k]];
        value[2 * k + 1] = (p->y_first ? first : second) * p->x[2 * points[k] + 1];
    }
    return 0;
}
/* "bond energy criterion: the path: it sums the work done on the bond since build or reset." LPS above nu = 1/3, four neighbours each, so
   m = 4 and theta = ex + ey: the ends of a bond give 2 (A theta + B e)/m, A > 0. Drawn along it first, it takes (A + B) e^2/4; after the
   body was made wide across, (3 A + B) e^2/4. The limit lies between both. */
static void work_on_bonds_is_of_the_path(void) {
    for (int round = 0; round < 2; ++round) { /* the second after a reset */
        int64_t along_x[2];
        for (int k = 0; k < 2; ++k) {
            const double nu = 0.45, mu = 1 / (2 * (1 + nu)), lambda = nu / (1 - nu * nu), A = 2 * lambda - 2 * mu, B = 8 * mu;
            const double e = 0.01, low = (A + B) * e * e / 4, high = (3 * A + B) * e * e / 4;
            specimen s = plate_of(PERI_LAW_LPS, 9, 9);
            s.desc.horizon = 1.2;
            s.desc.geometry = PERI_GEOMETRY_LINEAR;
            s.material.poisson = nu;
            s.material.criterion = PERI_CRITERION_BOND_ENERGY;
            s.material.fracture_energy = 0.5 * (low + high) * 2 * pow(1.2, 3) / 3; /* w0 = 3 G0/(2 h^3) */
            peri_body *b = specimen_make(&s);
            double *x = get(b, PERI_FIELD_POSITION);
            path p = {x, k, e};
            MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, strain_on, &p));
            for (int again = 0; again <= round; ++again) {
                MUST(b, peri_reset(b));
                MUST(b, run(b, 200, 0.01, (double)NAN));
            }
            along_x[k] = peri_bond_is_intact(b, 9 * 4 + 4, 9 * 4 + 5);
            CHECK(peri_bond_is_intact(b, 9 * 4 + 4, 9 * 5 + 4) == !along_x[k]); /* across it is the other way round */
            free(x);
            peri_body_destroy(b);
        }
        CHECK(along_x[0] == 1 && along_x[1] == 0);
    }
}

static double times[64];
static int64_t frames;
static int32_t note_frame(void *user, peri_body *b) {
    (void)user;
    times[frames++ % 64] = peri_time(b);
    return 0;
}
/* "A duration is divided into steps of one size, and the last two are shortened to end exactly": "the last two steps are shortened
   alike". */
static void last_two_steps(void) {
    peri_advance_desc a;
    peri_body *b = plate(8, 4);
    peri_advance_desc_init(&a);
    a.time_step = 0.25;
    a.frame_steps = 1;
    a.on_frame = note_frame;
    for (int k = 0; k < 8; ++k) {
        a.duration = 0.25 * 7 + 0.03 * (k + 1);
        frames = 0;
        MUST(b, peri_reset(b));
        MUST(b, peri_advance(b, &a));
        CHECK(frames == 8 && peri_step_count(b) == 8);
        for (int n = 0; n < 6; ++n) CHECK_NEAR(times[n] - (n ? times[n - 1] : 0), 0.25, 1e-13, 0);
        CHECK_NEAR(times[7] - times[6], times[6] - times[5], 1e-13, 0);
        CHECK_NEAR(times[7], a.duration, 4e-16, 0);
    }
    peri_body_destroy(b);
}

/* "every frame_steps steps and at the end of the run". */
static void frames_come_every_so_many_steps(void) {
    const int64_t steps[4] = {23, 20, 3, 7}, every[4] = {5, 5, 5, 0}, want[4] = {5, 4, 1, 1};
    for (int k = 0; k < 4; ++k) {
        peri_advance_desc a;
        peri_body *b = plate(8, 4);
        peri_advance_desc_init(&a);
        a.steps = steps[k];
        a.time_step = 0.25;
        a.frame_steps = every[k];
        a.on_frame = note_frame;
        frames = 0;
        MUST(b, peri_advance(b, &a));
        CHECK(frames == want[k]);
        for (int64_t n = 0; n < frames; ++n)
            CHECK_NEAR(times[n], 0.25 * (double)(n + 1 < frames ? every[k] * (n + 1) : steps[k]), 1e-13, 0);
        peri_body_destroy(b);
    }
}

/* PERI_ERROR_UNSTABLE: "a point (index) is faster than 1e9 speeds of sound": one point that is accelerated to 0.9 and to 1.1 of that. */
static void faster_than_1e9_speeds_of_sound(void) {
    for (int k = 0; k < 2; ++k) {
        const double v = k ? 1.1e9 : 0.9e9, dt = 1e-9, push[2] = {v / dt, 0};
        const int32_t which = 13;
        peri_body *b = plate(8, 4);
        MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, &which)), push, NULL, NULL));
        if (k) {
            REFUSE(b, PERI_ERROR_UNSTABLE, run(b, 1, dt, 1));
            CHECK(seen.index == 13);
        } else MUST(b, run(b, 1, dt, 1)); /* half a kick at the start, half at the end */
        peri_body_destroy(b);
    }
}

/* peri_energy.fracture is more "by what bonds hold beyond their limit as they break: in the step in which they pass it, ... and after a
   no-fail zone was lifted": a pair of points stretched to 3 times the limit while it may not fail takes 9 times the energy of the limit.
   */
static void limits_are_passed(void) {
    double fracture[2];
    for (int k = 0; k < 2; ++k) {
        const double x[4] = {0, 0, 1, 0}, volume[2] = {1, 1}, pull[2] = {k ? 0.0300001 : 0.0100001, 0};
        const int32_t second = 1;
        specimen s = plate_of(PERI_LAW_BOND_BASED, 1, 1);
        peri_energy e;
        s.desc.horizon = 1.5;
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        s.material.critical_stretch = 0.01;
        peri_body *b = specimen_start(&s);
        MUST(b, peri_add_points(b, 2, x, volume, NULL));
        MUST(b, peri_build(b));
        if (k) MUST(b, peri_set_no_fail(b, PERI_ALL, 1));
        MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_points(b, NULL, 1, &second)), pull));
        MUST(b, run(b, 1, 1e-9, (double)NAN));
        CHECK(peri_broken_count(b) == !k);
        if (k) MUST(b, peri_set_no_fail(b, PERI_ALL, 0));
        MUST(b, run(b, 1, 1e-9, (double)NAN));
        CHECK(peri_broken_count(b) == 1);
        MUST(b, peri_get_energy(b, &e));
        fracture[k] = e.fracture;
        peri_body_destroy(b);
    }
    CHECK_NEAR(fracture[1], 9 * fracture[0], 1e-4, 0);
    CHECK(fracture[0] > 0);
}

static int32_t rise(void *user, double time, double *place, double *turn) {
    (void)user, (void)turn;
    place[1] += 0.2 * time;
    return 0;
}
/* "Initial cracks, sets, loads, obstacles (at their first place) and no-fail zones stay" at peri_reset: the run after it is that of a body
   which was set up alike. */
static void what_stays_at_reset(void) {
    double *u[2];
    for (int k = 0; k < 2; ++k) {
        const double from[2] = {4, 7}, to[2] = {4, 3}, pull[2] = {2e-3, 0}, at[2] = {0, -0.1}, up[2] = {0, 1}, v[2] = {-0.08, 0};
        specimen s = plate_of(PERI_LAW_BOND_BASED, 8, 6);
        s.material.critical_stretch = 0.02;
        peri_body *b = specimen_make(&s);
        MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
        const int32_t grip = columns(b, 0, 2);
        MUST(b, peri_set_no_fail(b, grip, 1));
        MUST(b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL));
        MUST(b, plane_obstacle(b, at, up, 0.05, rise, NULL));
        MUST(b, peri_prescribe_velocity(b, grip, PERI_AXIS_XY, v, NULL, NULL));
        if (k) {
            MUST(b, run(b, 40, 0.3, (double)NAN));
            CHECK(peri_broken_count(b) > 0);
            MUST(b, peri_reset(b));
            CHECK(peri_time(b) == 0 && peri_step_count(b) == 0 && peri_broken_count(b) == 0 && peri_cut_count(b) > 0);
            CHECK(peri_size_of_set(b, grip) == 12);
        }
        MUST(b, run(b, 40, 0.3, 1));
        CHECK(peri_broken_count(b) > 0);
        u[k] = get(b, PERI_FIELD_DISPLACEMENT);
        peri_body_destroy(b);
    }
    CHECK(memcmp(u[0], u[1], 96 * sizeof(double)) == 0);
    free(u[0]);
    free(u[1]);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(broken_bonds_stay_broken);
    RUN(parts_pass_through_each_other);
    RUN(load_factors);
    RUN(reactions_before_a_step);
    RUN(velocity_of_a_prescribed_displacement);
    RUN(supports_fall_back);
    RUN(tractions_keep_their_bonds);
    RUN(null_prescribes_zero);
    RUN(reach_of_a_grip);
    RUN(removed_loads);
    RUN(starts_add_up);
    RUN(stiffest_material_of_an_obstacle);
    RUN(work_on_bonds_is_of_the_path);
    RUN(last_two_steps);
    RUN(frames_come_every_so_many_steps);
    RUN(faster_than_1e9_speeds_of_sound);
    RUN(limits_are_passed);
    RUN(what_stays_at_reset);
    return test_end("test_promises_runs");
}
