/* SPDX-License-Identifier: MIT */
/* Forces as a function of the caller's displacement.

   SOURCE OF TRUTH: the library's own run, whose bits a loop of the caller's has in units that are powers of two; the energy, of which
   nodal forces are the negative derivative; fields of a body that was moved there; geometry, for which bonds a strain breaks. */
#include "refusal.h"
#include "restart_scene.h"

enum { MOST = 600 };
static const int32_t laws[4] = { PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE };
/* ---- a loop of the caller's --------------------------------------------------------------------------------------- */

typedef struct loop {
    double dt, time, u[MOST], v[MOST], f[MOST], impulse[MOST], rho[MOST];
    int64_t broken;
} loop;

/* Velocity Verlet, in the order of explicit.c. */
static void own_steps(peri_body *b, loop *w, int steps, int within) {
    const int64_t points = peri_point_count(b), dim = peri_dimension(b);
    peri_evaluate_desc e;
    peri_evaluate_report r;
    peri_evaluate_desc_init(&e);
    e.displacement = w->u;
    e.velocity = w->v;
    e.force = w->f;
    e.fracture = 1;
    if (w->time == 0) (void)MUST(b, peri_evaluate(b, &e, NULL));
    if (within) e.impulse = w->impulse, e.time_step = w->dt;
    for (int n = 0; n < steps; ++n) {
        for (int64_t k = 0; k < points * dim; ++k) {
            w->v[k] += 0.5 * w->dt / w->rho[k / dim] * w->f[k];
            w->u[k] += w->dt * w->v[k];
        }
        e.time = w->time += w->dt;
        (void)MUST(b, peri_evaluate(b, &e, &r));
        w->broken += r.broken;
        for (int64_t k = 0; k < points * dim; ++k) {
            if (within) w->v[k] += w->impulse[k] / w->rho[k / dim];
            w->v[k] += 0.5 * w->dt / w->rho[k / dim] * w->f[k];
        }
    }
}

static int32_t swell(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)points;
    for (int64_t k = 0; k < count; ++k) value[2 * k] = 0.05 * sin(0.3 * time), value[2 * k + 1] = -0.02 * time;
    return 0;
}

/* A notched plate in motion, swollen by a body force and hit by a ball: in units that are powers of two, or not. */
static peri_body *plate(int32_t law, int32_t criterion, int32_t precision, int32_t timing, double unit) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.25, 0.5 * unit, 2.1, 10, 6, 0);
    const double from[2] = { 2.5 * unit, -1 }, to[2] = { 2.5 * unit, 1.2 * unit }, centre[2] = { 3 * unit, -0.9 * unit };
    double motion[MOST];
    uint64_t seed = 3;
    s.desc.precision = precision;
    s.desc.break_timing = timing;
    s.desc.thickness = 0.25;
    s.material.young = 4 * unit;
    s.material.density = unit;
    s.material.criterion = criterion;
    if (criterion == PERI_CRITERION_STRETCH) s.material.critical_stretch = 0.02;
    else s.material.fracture_energy = 0.002 * unit * unit;
    peri_body *b = specimen_make(&s);
    (void)MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    (void)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, swell, NULL));
    (void)MUST(b, ball_obstacle(b, centre, 0.8 * unit, 0, swing, NULL));
    for (int64_t k = 0; k < 120; ++k) motion[k] = 0.0625 * (test_random(&seed) - 0.5);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, motion, 120));
    return b;
}

/* Largest difference of u and v over their size; -1 where other bonds are broken. */
static double loops_differ(int32_t law, int32_t criterion, int32_t precision, int32_t timing, double unit, int steps) {
    static loop w;
    static double u[MOST], v[MOST], damage[2][MOST];
    peri_body *a = plate(law, criterion, precision, timing, unit), *b = plate(law, criterion, precision, timing, unit);
    peri_advance_desc run;
    double apart = 0;
    memset(&w, 0, sizeof w);
    w.dt = unit == 1 ? 0.046875 : 0.0463 * unit;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, w.v, 120));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DENSITY, w.rho, 60));
    peri_advance_desc_init(&run);
    run.steps = steps;
    run.time_step = w.dt;
    (void)MUST(a, peri_advance(a, &run));
    own_steps(b, &w, steps, timing == PERI_BREAK_WITHIN_STEP);
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, u, 120));
    (void)MUST(a, peri_get_field(a, PERI_FIELD_VELOCITY, v, 120));
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DAMAGE, damage[0], 60));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DAMAGE, damage[1], 60));
    CHECK(peri_broken_count(a) > 15 && w.broken == peri_broken_count(b));
    for (int k = 0; k < 120; ++k) {
        apart = fmax(apart, fabs(u[k] - w.u[k]) / largest(u, 120));
        apart = fmax(apart, fabs(v[k] - w.v[k]) / largest(v, 120));
    }
    if (memcmp(damage[0], damage[1], 60 * sizeof(double)) != 0) apart = -1;
    CHECK_NEAR(peri_time(b), steps * w.dt, 1e-13, 0);
    peri_body_destroy(a);
    peri_body_destroy(b);
    return apart;
}

static void a_loop_has_the_bits_of_a_run(void) {
    for (int law = 0; law < 4; ++law)
        for (int32_t criterion = PERI_CRITERION_STRETCH; criterion <= PERI_CRITERION_STRETCH + (law ? 2 : 0); ++criterion)
            for (int32_t timing = PERI_BREAK_WITHIN_STEP; timing <= PERI_BREAK_AFTER_DRIFT; ++timing) {
                CHECK(loops_differ(laws[law], criterion, PERI_PRECISION_DOUBLE, timing, 1, 200) == 0);
                CHECK(loops_differ(laws[law], criterion, PERI_PRECISION_MIXED, timing, 1, 200) == 0);
            }
}

static void a_loop_in_any_units(void) {
    for (int law = 0; law < 4; ++law) {
        const double apart = loops_differ(laws[law], PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, PERI_BREAK_WITHIN_STEP, 0.37, 200);
        CHECK(apart >= 0);
        CHECK_NEAR(apart, 0, 0, 1e-12);
    }
}

/* The caller's work counts as initial, and what fracture took is in it. */
static void the_ledger_of_a_loop_closes(void) {
    static loop w;
    peri_energy e;
    peri_body *b = plate(PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, PERI_BREAK_WITHIN_STEP, 1);
    memset(&w, 0, sizeof w);
    w.dt = 0.0625;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, w.v, 120));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DENSITY, w.rho, 60));
    own_steps(b, &w, 150, 1);
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK(fabs(e.fracture) > 1e-3 * e.initial);
    CHECK_NEAR(e.error, 0, 0, 1e-13 * e.initial);
    CHECK_NEAR(e.initial, e.kinetic + e.elastic + e.fracture, 1e-13, 0);
    scene_run(b, 20); /* and a run that follows has its own */
    (void)MUST(b, peri_get_energy(b, &e));
    CHECK_NEAR(e.error, 0, 0, 0.02 * e.initial);
    peri_body_destroy(b);
}

/* ---- the body stays ----------------------------------------------------------------------------------------------- */

/* The same forces as of a body that was moved there, and no bit of this one is another. */
static void the_body_stays(void) {
    static double u[MOST], f[MOST], want[MOST], product[2][MOST];
    const double from[2] = { 2.7, -1 }, to[2] = { 2.7, 1 };
    for (int k = 0; k < 24; ++k) {
        const int solid = k % 2, law = k / 2 % 4, precision = k / 8;
        scene s = scene_of(laws[law], PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE + precision, k % 3 == 0);
        if (solid) s.space = PERI_SPACE_SOLID;
        peri_body *b = scene_make(&s), *still = NULL, *there = NULL;
        const int64_t dofs = peri_point_count(b) * peri_dimension(b);
        peri_evaluate_desc e;
        scene_run(b, 60);
        if (!solid) (void)MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to)); /* what is derived from bonds is stale */
        (void)MUST(NULL, peri_body_clone(b, &still, NULL));
        (void)MUST(NULL, peri_body_clone(b, &there, NULL));
        for (int64_t load = 1; load <= 2; ++load) (void)MUST(there, peri_remove_load(there, peri_id(there, PERI_KIND_LOAD, load)));
        (void)MUST(there, peri_remove_obstacle(there, peri_id(there, PERI_KIND_OBSTACLE, 1)));
        shape_of(u, dofs, 0.01);
        (void)MUST(there, peri_set_field(there, PERI_FIELD_DISPLACEMENT, u, dofs));
        (void)MUST(there, peri_get_field(there, PERI_FIELD_FORCE_DENSITY, want, dofs));
        peri_evaluate_desc_init(&e);
        e.displacement = u;
        e.force = f;
        (void)MUST(b, peri_evaluate(b, &e, NULL));
        CHECK(alike(f, want, dofs, precision == 2 ? 3e-5 : precision == 1 ? 1e-6 : 1e-13));
        CHECK(same_state(b, still));
        (void)MUST(b, peri_evaluate(b, &e, NULL)); /* and products with the stiffness are those of this body */
        (void)MUST(b, peri_multiply_stiffness(b, u, product[0], dofs));
        (void)MUST(still, peri_multiply_stiffness(still, u, product[1], dofs));
        CHECK(memcmp(product[0], product[1], (size_t)dofs * sizeof(double)) == 0);
        scene_run(b, 20);
        scene_run(still, 20);
        CHECK(same_state(b, still));
        peri_body_destroy(b);
        peri_body_destroy(still);
        peri_body_destroy(there);
    }
}

/* Nodal forces of bonds are the negative derivative of the energy: by central differences of it, whose error is O(h^2). */
static void forces_are_the_slope_of_the_energy(void) {
    static double u[MOST], f[MOST];
    for (int k = 0; k < 16; ++k) {
        scene s = scene_of(laws[k % 4], PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, k / 4 % 2);
        s.geometry = k / 8 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
        peri_body *b = scene_make(&s);
        const int64_t dofs = peri_point_count(b) * peri_dimension(b), at[3] = { 3, 41, dofs - 2 };
        peri_evaluate_desc e;
        peri_evaluate_report r;
        scene_run(b, 40); /* some bonds are gone */
        shape_of(u, dofs, 0.02);
        peri_evaluate_desc_init(&e);
        e.displacement = u;
        e.external = 0;
        e.nodal = 1;
        e.energy = 1;
        for (int n = 0; n < 3; ++n) {
            const double h = 1e-4, here = u[at[n]];
            double side[2];
            e.force = f;
            (void)MUST(b, peri_evaluate(b, &e, &r));
            e.force = NULL;
            for (int way = 0; way < 2; ++way) {
                u[at[n]] = way ? here + h : here - h;
                (void)MUST(b, peri_evaluate(b, &e, &r));
                side[way] = r.energy;
            }
            u[at[n]] = here;
            CHECK_NEAR(f[at[n]], (side[0] - side[1]) / (2 * h), 1e-5, 1e-6 * largest(f, dofs));
        }
        peri_body_destroy(b);
    }
}

/* Bonds, loads, both; densities and nodal forces; any strides and precision of the arrays. */
static void parts_and_forms_agree(void) {
    static double u[MOST], all[MOST], bonds[MOST], loads[MOST], volume[MOST], wide[4 * MOST];
    static float narrow[MOST], out[MOST];
    const scene s = scene_of(PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, 1);
    peri_body *b = scene_make(&s);
    const int64_t points = peri_point_count(b), dofs = points * 2;
    peri_evaluate_desc e;
    scene_run(b, 30);
    shape_of(u, dofs, 0.5);
    peri_evaluate_desc_init(&e);
    e.displacement = u;
    e.time = 2.5;
    e.force = all, (void)MUST(b, peri_evaluate(b, &e, NULL));
    e.external = 0, e.force = bonds, (void)MUST(b, peri_evaluate(b, &e, NULL));
    e.external = 1, e.bonds = 0, e.force = loads, (void)MUST(b, peri_evaluate(b, &e, NULL));
    for (int64_t k = 0; k < dofs; ++k) wide[k] = bonds[k] + loads[k];
    CHECK(alike(wide, all, dofs, 1e-14) && largest(loads, dofs) > 1e-3 && !alike(bonds, all, dofs, 1e-6));
    e.bonds = e.nodal = 1;
    e.force = loads;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_VOLUME, volume, points));
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    for (int64_t k = 0; k < dofs; ++k) all[k] *= volume[k / 2] * 0.3;
    CHECK(alike(loads, all, dofs, 1e-14));
    for (int64_t k = 0; k < 4 * MOST; ++k) wide[k] = NAN; /* planes of y and x, three apart */
    for (int64_t i = 0; i < points; ++i) wide[3 * i] = u[2 * i], wide[900 + 3 * i] = u[2 * i + 1];
    e.point_stride = 3, e.component_stride = 900;
    e.displacement = e.force = wide;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    for (int64_t i = 0; i < points; ++i) CHECK(wide[3 * i] == loads[2 * i] && wide[900 + 3 * i] == loads[2 * i + 1]);
    CHECK(isnan(wide[1]) && isnan(wide[901]) && isnan(wide[3 * points]));
    for (int64_t k = 0; k < dofs; ++k) narrow[k] = (float)u[k], u[k] = narrow[k];
    e.point_stride = e.component_stride = 0;
    e.displacement = u, e.force = all;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    e.type = PERI_TYPE_F32;
    e.displacement = narrow, e.force = out;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    for (int64_t k = 0; k < dofs; ++k) CHECK(out[k] == (float)all[k]);
    peri_body_destroy(b);
}

/* Loads at a time and a factor of the caller's: the force density they are given by. */
static void loads_at_any_time_and_factor(void) {
    double f[MOST], u[MOST] = { 0 };
    const double pull[2] = { 0.25, -1.5 };
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.1, 6, 5, 0);
    peri_body *b = specimen_make(&s);
    const int32_t one = 7, set = (int32_t)MUST(b, peri_select_points(b, NULL, 1, &one));
    peri_evaluate_desc e;
    (void)MUST(b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL));
    (void)MUST(b, peri_apply_body_force(b, set, NULL, swell, NULL));
    peri_evaluate_desc_init(&e);
    e.displacement = u, e.force = f, e.bonds = 0, e.time = 3, e.load_factor = -2;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    for (int k = 0; k < 60; ++k) {
        const double more = k == 14 ? 0.05 * sin(0.9) : k == 15 ? -0.06 : 0;
        CHECK_NEAR(f[k], -2 * pull[k % 2] + more, 1e-14, 0);
    }
    CHECK(peri_time(b) == 0 && peri_load_factor(b) == 0);
    peri_body_destroy(b);
}

/* ---- the criteria, once ------------------------------------------------------------------------------------------- */

/* A strain e along x stretches a bond at the angle a by e cos^2 a where the geometry is linear: those over s0 break, the others do not. */
static void a_strain_breaks_what_geometry_says(void) {
    double x[MOST], u[MOST], f[MOST];
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.01, 9, 7, 0);
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.critical_stretch = 0.01;
    peri_body *b = specimen_make(&s);
    int64_t want = 0;
    peri_evaluate_desc e;
    peri_evaluate_report r;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 126));
    for (int i = 0; i < 63; ++i) u[2 * i] = 0.0149 * x[2 * i], u[2 * i + 1] = 0;
    for (int32_t i = 0; i < 63; ++i)
        for (int32_t j = i + 1; j < 63; ++j) {
            const double dx = x[2 * j] - x[2 * i], dy = x[2 * j + 1] - x[2 * i + 1], cosine = dx * dx / (dx * dx + dy * dy);
            if (dx * dx + dy * dy < 9.1) want += 0.0149 * cosine > 0.01;
        }
    peri_evaluate_desc_init(&e);
    e.displacement = u, e.force = f;
    (void)MUST(b, peri_evaluate(b, &e, &r));
    CHECK(r.broken == 0 && peri_broken_count(b) == 0);
    e.fracture = 1;
    (void)MUST(b, peri_evaluate(b, &e, &r));
    CHECK(want > 50 && r.broken == want && peri_broken_count(b) == want);
    (void)MUST(b, peri_evaluate(b, &e, &r));
    CHECK(r.broken == 0);
    (void)MUST(b, peri_reset(b)); /* and where the caller has put the body itself */
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 126));
    e.displacement = e.force = NULL;
    e.energy = 1;
    (void)MUST(b, peri_evaluate(b, &e, &r));
    peri_energy energy;
    (void)MUST(b, peri_get_energy(b, &energy));
    CHECK(r.broken == want && r.energy == energy.elastic && r.energy > 0);
    peri_body_destroy(b);
}

static int32_t note_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    double *noted = (double *)user;
    CHECK(i < j && stretch > 0.02);
    noted[0] += 1;
    noted[1] = time;
    return noted[0] == 3;
}

/* Events come with the time of the call; one that asks for a stop is told of after the call is whole. */
static void breaks_are_told(void) {
    static loop w;
    double noted[2] = { 0, 0 };
    peri_body *b = plate(PERI_LAW_BOND_BASED, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, PERI_BREAK_AFTER_DRIFT, 1);
    peri_evaluate_desc e;
    peri_evaluate_report r;
    memset(&w, 0, sizeof w);
    (void)MUST(b, peri_on_break(b, note_break, noted));
    shape_of(w.u, 120, 0.3);
    peri_evaluate_desc_init(&e);
    e.displacement = w.u, e.fracture = 1, e.time = 7.25;
    CHECK(peri_evaluate(b, &e, &r) == PERI_STOPPED);
    CHECK(noted[0] == (double)r.broken && r.broken > 3 && noted[1] == 7.25 && peri_time(b) == 7.25);
    peri_body_destroy(b);
}

/* ---- what a solver of the caller's needs -------------------------------------------------------------------------- */

/* K at a displacement: that of a body that was moved there, and the slope of the forces; this body stays. */
static void products_at_a_displacement(void) {
    static double u[MOST], p[MOST], out[MOST], want[MOST], side[2][MOST];
    for (int k = 0; k < 16; ++k) {
        scene s = scene_of(laws[k % 4], PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, k / 4 % 2);
        s.geometry = k / 8 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
        peri_body *b = scene_make(&s), *still = NULL, *there = NULL;
        const int64_t dofs = peri_point_count(b) * 2;
        peri_evaluate_desc e;
        scene_run(b, 30);
        (void)MUST(NULL, peri_body_clone(b, &still, NULL));
        (void)MUST(NULL, peri_body_clone(b, &there, NULL));
        shape_of(u, dofs, 0.05);
        for (int64_t n = 0; n < dofs; ++n) p[n] = cos((double)(3 * n));
        (void)MUST(b, peri_multiply_stiffness_at(b, u, p, out, dofs));
        CHECK(same_state(b, still));
        (void)MUST(there, peri_set_field(there, PERI_FIELD_DISPLACEMENT, u, dofs));
        (void)MUST(there, peri_multiply_stiffness(there, p, want, dofs));
        CHECK(alike(out, want, dofs, 1e-13));
        peri_evaluate_desc_init(&e);
        e.displacement = want, e.nodal = 1, e.external = 0;
        for (int way = 0; way < 2; ++way) {
            for (int64_t n = 0; n < dofs; ++n) want[n] = u[n] + (way ? 1e-5 : -1e-5) * p[n];
            e.force = side[way];
            (void)MUST(b, peri_evaluate(b, &e, NULL));
        }
        for (int64_t n = 0; n < dofs; ++n) want[n] = (side[0][n] - side[1][n]) / 2e-5;
        CHECK(alike(out, want, dofs, 1e-6));
        peri_body_destroy(b);
        peri_body_destroy(still);
        peri_body_destroy(there);
    }
}

/* Mass and density are the material's; held is what supports own. */
static void masses_and_held_components(void) {
    double mass[MOST], held[MOST], rho[MOST], x[MOST], total = 0;
    const double lo[2] = { 0, 0 }, hi[2] = { 3, 2 }, far[2] = { 5, 2 };
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_BOND_BASED, 0, 0.5, 2.1, 1, 1, 0);
    s.desc.thickness = 0.25;
    s.material.density = 3;
    peri_body *b = specimen_start(&s);
    s.material.density = 0.7;
    const int32_t light = (int32_t)MUST(b, peri_add_material(b, &s.material));
    (void)MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 0.5));
    const double other[2] = { 3, 0 };
    (void)MUST(b, peri_add_box(b, light, other, far, 0.5));
    (void)MUST(b, peri_build(b));
    const int32_t set = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), points = (int32_t)peri_point_count(b);
    const int32_t first = (int32_t)MUST(b, peri_prescribe_displacement(b, set, PERI_AXIS_XY, NULL, NULL, NULL));
    (void)MUST(b, peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_Y, NULL, NULL, NULL));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * points));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_MASS, mass, points));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DENSITY, rho, points));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_HELD, held, 2 * points));
    for (int32_t i = 0; i < points; ++i) {
        total += mass[i];
        CHECK(rho[i] == (x[2 * i] < 3 ? 3 : 0.7) && held[2 * i] == (x[2 * i] < 3) && held[2 * i + 1] == 1);
    }
    CHECK_NEAR(total, 3 * 6 * 0.25 + 0.7 * 4 * 0.25, 1e-14, 0);
    (void)MUST(b, peri_remove_load(b, first));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_HELD, held, 2 * points));
    for (int32_t i = 0; i < points; ++i) CHECK(held[2 * i] == 0 && held[2 * i + 1] == 1);
    peri_body_destroy(b);
}

static int32_t fails(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)time, (void)count, (void)points, (void)value;
    return -5;
}

/* A load that fails ends the call before the body has moved; without loads the same call goes well. */
static void a_load_that_fails(void) {
    double u[MOST], f[MOST], now[MOST];
    peri_body *b = plate(PERI_LAW_BOND_BASED, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, PERI_BREAK_WITHIN_STEP, 1);
    peri_evaluate_desc e;
    shape_of(u, 120, 0.3);
    (void)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, fails, NULL));
    peri_evaluate_desc_init(&e);
    e.displacement = u, e.force = f, e.time = 3, e.load_factor = 2;
    for (e.fracture = 0; e.fracture < 2; ++e.fracture) {
        REFUSE(b, PERI_ERROR_CALLBACK, peri_evaluate(b, &e, NULL));
        CHECK(seen.value == -5);
        (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, now, 120));
        CHECK(largest(now, 120) == 0 && peri_time(b) == 0 && peri_load_factor(b) == 0 && peri_broken_count(b) == 0);
    }
    e.fracture = 1;
    e.external = 0;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    CHECK(peri_time(b) == 3 && peri_load_factor(b) == 2 && peri_broken_count(b) > 0);
    peri_body_destroy(b);
}

/* Of state-based bodies, as in a run: families of fewer bonds are stiffer. */
static void the_stable_step_follows_breaks(void) {
    static double u[MOST];
    scene s = scene_of(PERI_LAW_OTERKUS, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, 0);
    s.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = scene_make(&s);
    const double before = peri_stable_step(b);
    peri_evaluate_desc e;
    shape_of(u, 120, 0.1);
    peri_evaluate_desc_init(&e);
    e.displacement = u, e.fracture = 1;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    const double after = peri_stable_step(b);
    CHECK(peri_broken_count(b) > 20 && after < 0.9 * before);
    peri_body_destroy(b);
}

/* Two blocks pressed into each other: contact adds forces where the body moves there, as much on one as on the other. */
static void contact_acts_where_the_body_moves(void) {
    const double lo[2] = { 0, 0 }, hi[2] = { 3, 4 }, from[2] = { 3.5, 0.4 }, to[2] = { 6.5, 3.4 };
    double u[MOST] = { 0 }, f[2][MOST], x[MOST], sum = 0, size = 0;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.1, 1, 1, 0);
    s.desc.horizon = 1.45;
    peri_body *b = specimen_start(&s);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    (void)MUST(b, peri_add_box(b, material, lo, hi, 1));
    (void)MUST(b, peri_add_box(b, material, from, to, 1));
    (void)MUST(b, peri_build(b));
    const int32_t points = (int32_t)peri_point_count(b);
    peri_contact_desc c;
    peri_contact_desc_init(&c);
    (void)MUST(b, peri_set_contact(b, PERI_ALL, PERI_ALL, &c));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * points));
    for (int32_t i = 0; i < points; ++i) u[2 * i] = x[2 * i] > 3.2 ? -0.9 : 0;
    peri_evaluate_desc e;
    peri_evaluate_desc_init(&e);
    e.displacement = u, e.nodal = 1;
    for (e.fracture = 0; e.fracture < 2; ++e.fracture) {
        e.force = f[e.fracture];
        (void)MUST(b, peri_evaluate(b, &e, NULL));
    }
    for (int32_t i = 0; i < points; ++i) {
        const double push = f[1][2 * i] - f[0][2 * i];
        sum += push, size = fmax(size, fabs(push));
        CHECK(x[2 * i] > 3.2 ? push >= 0 : push <= 0);
    }
    CHECK(size > 0.01 && fabs(sum) < 1e-14);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(a_loop_has_the_bits_of_a_run);
    RUN(a_loop_in_any_units);
    RUN(the_ledger_of_a_loop_closes);
    RUN(the_body_stays);
    RUN(forces_are_the_slope_of_the_energy);
    RUN(parts_and_forms_agree);
    RUN(loads_at_any_time_and_factor);
    RUN(a_strain_breaks_what_geometry_says);
    RUN(breaks_are_told);
    RUN(products_at_a_displacement);
    RUN(masses_and_held_components);
    RUN(a_load_that_fails);
    RUN(the_stable_step_follows_breaks);
    RUN(contact_acts_where_the_body_moves);
    return test_end("test_evaluate");
}
