/* SPDX-License-Identifier: MIT */
/* test_survivors_marks.c - what `make mutants` found that no other test of failed steps, job systems and pressures looked at.

   SOURCE OF TRUTH: peri.h (PERI_ERROR_UNSTABLE and the first offending point, peri_advance after a failure, job systems); a product changes
   nothing; Hooke's law of a plate under pressure from all sides. */
#include "refusal.h"

static int32_t side(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e9, -1e9}, hi[3] = {to, 1e9, 1e9};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}
static peri_body *plate(int32_t law, int nx, int ny, int32_t geometry) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 1, 2.2, nx, ny, 1);
    s.desc.geometry = geometry;
    return specimen_make(&s);
}

/* Two points of different blocks pass the limit in one step: the first of them is told. */
static void the_first_unstable_point(void) {
    const double huge[2] = {1e30, 0};
    const int32_t points[3] = {2900, 7, 1500};
    peri_advance_desc a;
    peri_body *b = plate(PERI_LAW_BOND_BASED, 60, 50, PERI_GEOMETRY_LINEAR);
    MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 3, points)), huge, NULL, NULL));
    peri_advance_desc_init(&a);
    a.steps = 1;
    REFUSE(b, PERI_ERROR_UNSTABLE, peri_advance(b, &a));
    CHECK(seen.index == 7);
    peri_body_destroy(b);
}

/* A job system is a callback: it may not change the body, also where a call that only reads has called it. */
typedef struct jobs {
    peri_body *body;
    int64_t calls, refused;
} jobs;
static void serve(void *user, int64_t count, peri_task_fn task, void *context) {
    const double v[2] = {1, 0};
    jobs *j = (jobs *)user;
    int64_t k;
    for (k = 0; k < count; ++k) task(context, k);
    if (!j->body) return;
    j->calls++;
    j->refused += peri_add_velocity(j->body, PERI_ALL, v) == PERI_ERROR_ORDER;
}
static void job_systems_change_nothing(void) {
    jobs j = {NULL, 0, 0};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1, 3, 80, 60, 1);
    peri_energy e;
    double *f;
    s.desc.parallel_for = serve;
    s.desc.parallel_user = &j;
    s.desc.threads = 2;
    peri_body *b = specimen_make(&s);
    j.body = b;
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    free(f);
    f = get(b, PERI_FIELD_ENERGY_DENSITY);
    free(f);
    MUST(b, peri_get_energy(b, &e));
    CHECK(j.calls > 0 && j.refused == j.calls && e.kinetic == 0);
    peri_body_destroy(b);
}

/* A load, or a support, fails within a step, and answers again: forces that are read then are those of the body where it is. */
typedef struct failing {
    int64_t calls, fails_at;
    double size;
} failing;
static int32_t fail_once(void *user, double time, int64_t count, const int32_t *points, double *value) {
    failing *f = (failing *)user;
    int64_t k;
    (void)time;
    (void)points;
    for (k = 0; k < count; ++k) value[2 * k] = f->size;
    return ++f->calls == f->fails_at ? -1 : 0;
}
static void forces_after_a_failed_step(void) {
    int supports, at;
    for (supports = 0; supports < 2; ++supports)
        for (at = 2; at < 6; ++at) {
            const double force[2] = {1e-2, 0};
            failing state = {0, at, supports ? 0.02 : 1e-2};
            peri_advance_desc a;
            double *u, *f, *g;
            int k;
            peri_body *b = plate(PERI_LAW_BOND_BASED, 12, 4, PERI_GEOMETRY_LINEAR);
            peri_body *c = plate(PERI_LAW_BOND_BASED, 12, 4, PERI_GEOMETRY_LINEAR);
            MUST(b, peri_apply_body_force(b, side(b, 6, 9), force, supports ? NULL : fail_once, &state));
            if (supports) MUST(b, peri_prescribe_velocity(b, side(b, 0, 3), PERI_AXIS_XY, NULL, fail_once, &state));
            peri_advance_desc_init(&a);
            a.steps = 10;
            REFUSE(b, PERI_ERROR_CALLBACK, peri_advance(b, &a));
            f = get(b, PERI_FIELD_FORCE_DENSITY);
            u = get(b, PERI_FIELD_DISPLACEMENT);
            MUST(c, peri_apply_body_force(c, side(c, 6, 9), force, NULL, NULL));
            put(c, PERI_FIELD_DISPLACEMENT, u);
            g = get(c, PERI_FIELD_FORCE_DENSITY);
            for (k = 0; k < 96; ++k)
                if (k % 24 >= 6) CHECK_NEAR(f[k], g[k], 1e-12, 1e-15); /* supports take what acts on the others */
            free(u);
            free(f);
            free(g);
            peri_body_destroy(b);
            peri_body_destroy(c);
        }
}

/* A first solve that fails at once: forces that are read after it are those at the factor where it began. */
static void a_first_solve_that_fails(void) {
    const double force[2] = {0, 1e-2};
    double time = -1, *f;
    peri_solve_desc s;
    peri_body *b = plate(PERI_LAW_BOND_BASED, 12, 4, PERI_GEOMETRY_LINEAR);
    MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, side(b, 9, 12), force, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, note_time, &time));
    peri_solve_desc_init(&s);
    s.load_from = 0.5;
    s.iterations = 1;
    REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &s, NULL));
    time = -1;
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK(time == 0.5 && peri_load_factor(b) == 0.5);
    free(f);
    peri_body_destroy(b);
}

/* Sums of displacements are below 1e15 spacings, those of supports times their factor, too: the body stays where it was. */
static void supports_that_lead_too_far(void) {
    const double far[2] = {1e14, 0};
    int method;
    for (method = PERI_METHOD_NEWTON; method <= PERI_METHOD_RELAXATION; ++method) {
        peri_solve_desc s;
        double *u;
        peri_body *b = plate(PERI_LAW_BOND_BASED, 12, 4, PERI_GEOMETRY_LINEAR);
        MUST(b, peri_prescribe_displacement(b, side(b, 0, 3), PERI_AXIS_XY, far, NULL, NULL));
        peri_solve_desc_init(&s);
        s.method = method;
        s.load_to = 1000;
        REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &s, NULL));
        FIELD_IS("DISPLACEMENT");
        u = get(b, PERI_FIELD_DISPLACEMENT);
        CHECK(largest(u, 96) < 1e15);
        free(u);
        peri_body_destroy(b);
    }
}

/* Products of the stiffness with large vectors between the steps of a body that breaks: bit for bit the run without them. */
static void products_leave_criteria_alone(void) {
    int32_t criterion, geometry;
    for (criterion = PERI_CRITERION_STRETCH; criterion <= PERI_CRITERION_NODE_ENERGY; ++criterion)
        for (geometry = PERI_GEOMETRY_NONLINEAR; geometry <= PERI_GEOMETRY_LINEAR; ++geometry) {
            double *u[2], in[144], out[144];
            int64_t broken[2];
            int k, n, times;
            uint64_t seed = 3;
            for (k = 0; k < 144; ++k) in[k] = 100 * (test_random(&seed) - 0.5);
            for (times = 0; times < 2; ++times) {
                const double from[2] = {6, -1}, to[2] = {6, 2.2}, left[2] = {-0.12, 0}, right[2] = {0.12, 0};
                specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1, 2.2, 12, 6, 1);
                s.desc.geometry = geometry;
                s.material.criterion = criterion;
                s.material.fracture_energy = 0.01;
                peri_body *b = specimen_make(&s);
                MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
                MUST(b, peri_prescribe_velocity(b, side(b, 0, 2), PERI_AXIS_XY, left, NULL, NULL));
                MUST(b, peri_prescribe_velocity(b, side(b, 10, 12), PERI_AXIS_XY, right, NULL, NULL));
                for (n = 0; n < 40; ++n) {
                    MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 0.2, 0));
                    if (times) MUST(b, peri_multiply_stiffness(b, in, out, 144));
                }
                u[times] = get(b, PERI_FIELD_DISPLACEMENT);
                broken[times] = peri_broken_count(b);
                peri_body_destroy(b);
            }
            CHECK(broken[0] == broken[1] && broken[0] > 0);
            CHECK(memcmp(u[0], u[1], 144 * sizeof(double)) == 0);
            free(u[0]);
            free(u[1]);
        }
}

/* Pressure p on all surfaces of a plate of correspondence: strain -p (1 - nu)/E along both axes. */
static void plates_under_pressure(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_CORRESPONDENCE, 0.3, 1, 2.2, 10, 8, 1);
    peri_solve_desc d;
    double *e;
    int k;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_apply_pressure(b, PERI_ALL, 1e-3, NULL, NULL));
    peri_solve_desc_init(&d);
    d.loose = PERI_LOOSE_BALANCED;
    d.tolerance = 1e-11;
    MUST(b, peri_solve(b, &d, NULL));
    e = get(b, PERI_FIELD_STRAIN);
    for (k = 0; k < 80; ++k) {
        CHECK_NEAR(e[3 * k], -0.7e-3, 1e-7, 0);
        CHECK_NEAR(e[3 * k + 1], -0.7e-3, 1e-7, 0);
        CHECK_NEAR(e[3 * k + 2], 0, 0, 1e-10);
    }
    free(e);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(the_first_unstable_point);
    RUN(job_systems_change_nothing);
    RUN(forces_after_a_failed_step);
    RUN(a_first_solve_that_fails);
    RUN(supports_that_lead_too_far);
    RUN(products_leave_criteria_alone);
    RUN(plates_under_pressure);
    return test_end("test_survivors_marks");
}
