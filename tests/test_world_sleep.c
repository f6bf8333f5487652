/* SPDX-License-Identifier: MIT */
/* test_world_sleep.c - bodies of a world that rest fall asleep, and wake when touched.

   SOURCE OF TRUTH: the same scene in a world in which nobody sleeps; Newton's laws: momentum, the balance of energy; the clock. */
#include "pool.h"
#include "world_scene.h"
#include <time.h>

static peri_world *sleepy(double speed, double time, pool *p) {
    peri_world_desc d;
    peri_world *w = NULL;
    peri_world_desc_init(&d);
    d.sleep_speed = speed;
    d.sleep_time = time;
    if (p) d.allocate = pool_take, d.release = pool_give, d.memory_user = p;
    CHECK(peri_world_create(&d, &w, NULL) == PERI_OK);
    return w;
}

/* ---- a stack ----------------------------------------------------------------------------------------------------------------------- */

enum { STACK = 3 };
static const double h = 0.05, weight = 1e-5;

/* Blocks one on the other, under their weight; the lowest is held below. E = rho = 1. */
static void stack_make(peri_body **b, peri_world *w, int single, int threads) {
    const double load[2] = {0, -weight};
    for (int k = 0; k < STACK; ++k) {
        const double lo[2] = {k * h, 4 * k * h}, hi[2] = {(8 - k) * h, 4 * (k + 1) * h}, bed[2] = {8 * h, h};
        peri_body_desc d;
        peri_body_desc_init(&d);
        d.space = PERI_SPACE_PLANE_STRAIN;
        d.precision = single ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        d.horizon = 3.01 * h;
        d.threads = threads;
        b[k] = test_unit_body(&d, 0);
        (void)MUST(b[k], peri_add_box(b[k], peri_id(b[k], PERI_KIND_MATERIAL, 1), lo, hi, h));
        (void)MUST(b[k], peri_build(b[k]));
        (void)MUST(b[k], peri_apply_body_force(b[k], PERI_ALL, load, NULL, NULL));
        if (k == 0)
            (void)MUST(b[0], peri_prescribe_displacement(b[0], (int32_t)MUST(b[0], peri_select_box(b[0], NULL, lo, bed)), PERI_AXIS_XY,
                                                         NULL, NULL, NULL));
        (void)world_must(w, peri_world_add(w, b[k]));
    }
}

static void stack_drop(peri_body **b, peri_world *w) {
    peri_world_destroy(w);
    for (int k = 0; k < STACK; ++k) peri_body_destroy(b[k]);
}

static double farthest_apart(peri_body *a, peri_body *b) {
    const int64_t n = 2 * peri_point_count(a);
    double x[64], y[64], most = 0;
    CHECK(n <= 64);
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, x, n));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, y, n));
    for (int64_t k = 0; k < n; ++k) most = fmax(most, fabs(x[k] - y[k]));
    return most;
}

/* It settles by damping as if nobody slept, sleeps where it is then, and the time goes on. */
static void a_stack_settles_and_sleeps(void) {
    for (int kind = 0; kind < 3; ++kind) { /* central differences, single precision */
        peri_body *b[STACK], *a[STACK];
        peri_world *w = sleepy(1e-9, 2, NULL), *v = world_make();
        peri_advance_desc r;
        peri_energy e, f;
        double force[2];
        int64_t steps = 0;
        stack_make(b, w, kind == 2, 1), stack_make(a, v, kind == 2, 1);
        peri_advance_desc_init(&r);
        r.damping = 2;
        r.integrator = kind == 1 ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET;
        r.time_step = 0.8 * peri_world_stable_step(w);
        r.steps = 50;
        (void)world_must(w, peri_world_advance(w, &r));
        (void)world_must(v, peri_world_advance(v, &r));
        CHECK(peri_world_asleep(w, NULL) == 0);
        for (int k = 0; k < STACK; ++k) CHECK(same_motion(b[k], a[k])); /* until then */
        for (; steps < 4000 && peri_world_asleep(w, NULL) == 0; steps += 50) (void)world_must(w, peri_world_advance(w, &r));
        CHECK(peri_world_asleep(w, NULL) == STACK);
        for (int k = 0; k < STACK; ++k) CHECK(peri_world_asleep(w, b[k]) == 1);
        r.steps = steps;
        (void)world_must(v, peri_world_advance(v, &r));
        r.steps = 500;
        (void)world_must(w, peri_world_advance(w, &r));
        (void)world_must(v, peri_world_advance(v, &r));
        CHECK(peri_world_asleep(w, NULL) == STACK && peri_world_asleep(v, NULL) == 0);
        for (int k = 0; k < STACK; ++k) {
            CHECK(farthest_apart(a[k], b[k]) < 1e-9);
            CHECK(peri_time(a[k]) == peri_time(b[k]) && peri_step_count(a[k]) == peri_step_count(b[k]));
        }
        (void)world_must(w, peri_world_get_force(w, b[STACK - 1], force));
        CHECK_NEAR(force[1] / (weight * 16 * h * h), 1, kind == 2 ? 1e-2 : 1e-3, 0); /* it weighs on the next, of 4 x 4 points */
        (void)world_must(w, peri_world_get_energy(w, &e));
        (void)world_must(v, peri_world_get_energy(v, &f));
        CHECK(e.kinetic == 0 && e.external > 0);
        CHECK_NEAR(e.external, f.external, 1e-4, 0);
        CHECK_NEAR((e.error - f.error) / f.external, 0, 0, kind == 2 ? 1e-6 : 1e-9); /* in single precision the other goes on to round */
        CHECK_NEAR(e.error / e.external, 0, 0, 0.01);
        stack_drop(b, w), stack_drop(a, v);
    }
}

/* What they have of motion is damping, to rounding: here it is much. */
static void motion_that_ends_is_damping(void) {
    const double v[2] = {0.01, 0};
    bars s = bars_of(2, 3, 6, 4);
    peri_body *b = bar_at(&s, 0, 0);
    peri_world *w = sleepy(0.02, 1e-6, NULL);
    peri_energy e;
    double kinetic;
    (void)MUST(b, peri_add_velocity(b, PERI_ALL, v));
    (void)world_must(w, peri_world_add(w, b));
    (void)world_must(w, peri_world_get_energy(w, &e));
    kinetic = e.kinetic;
    CHECK_NEAR(kinetic, 0.5 * 2440 * 24e-6 * 1e-4, 1e-12, 0);
    (void)world_must(w, world_for(w, 0.9e-6));
    CHECK(peri_world_asleep(w, b) == 0);
    (void)world_must(w, world_for(w, 0.6e-6));
    CHECK(peri_world_asleep(w, b) == 1);
    (void)world_must(w, peri_world_get_energy(w, &e));
    CHECK(e.kinetic == 0);
    CHECK_NEAR(e.damping, kinetic, 1e-12, 0);
    CHECK_NEAR(e.error / kinetic, 0, 0, 1e-12);
    peri_world_destroy(w);
    peri_body_destroy(b);
}

/* ---- a strike ---------------------------------------------------------------------------------------------------------------------- */

enum { ROW = 4 }; /* two that touch, one that is alone; the striker */

static void row_make(peri_body **b, peri_world *w, int threads) {
    bars s = bars_of(2, 3, 6, 4);
    s.desc.threads = threads;
    for (int k = 0; k < ROW; ++k) {
        const double x[ROW] = {0, 6e-3, 30e-3, -9e-3};
        s.desc.precision = k == 1 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
        b[k] = bar_at(&s, x[k], k == 3 ? 40 : 0);
        (void)world_must(w, peri_world_add(w, b[k]));
    }
}

static void row_drop(peri_body **b, peri_world *w) {
    for (int k = 0; k < ROW; ++k) peri_body_destroy(b[k]);
    peri_world_destroy(w);
}

/* Bodies that have never moved sleep as they would rest: struck, all goes as if they had been awake, to the last bit. */
static void the_struck_wake_in_that_step(void) {
    for (int kind = 0; kind < 3; ++kind) { /* central differences, threads */
        peri_body *b[ROW], *a[ROW];
        peri_world *w = sleepy(1e-3, 1e-6, NULL), *v = world_make();
        peri_advance_desc r;
        double before[2], p[2], sum;
        int32_t woke = 0;
        row_make(b, w, kind == 2 ? 3 : 1), row_make(a, v, 1);
        (void)MUST(b[3], peri_get_momentum(b[3], before, NULL));
        peri_advance_desc_init(&r);
        r.integrator = kind == 1 ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET;
        r.time_step = 0.7 * peri_world_stable_step(w);
        r.steps = kind == 1 ? 20 : 1;
        for (int step = 0; step < 1600; step += (int)r.steps) {
            double force[2], total = 0;
            (void)world_must(w, peri_world_advance(w, &r));
            (void)world_must(v, peri_world_advance(v, &r));
            sum = 0;
            for (int k = 0; k < ROW; ++k) {
                (void)world_must(w, peri_world_get_force(w, b[k], force));
                (void)MUST(b[k], peri_get_momentum(b[k], p, NULL));
                total += force[0];
                sum += p[0];
                if (k == 3 && force[0] != 0) CHECK(peri_world_asleep(w, b[0]) == 0 && peri_world_asleep(w, b[1]) == 0);
            }
            CHECK(fabs(total) <= 1e-12 * (fabs(force[0]) + 1));
            CHECK_NEAR(sum, before[0], 1e-6, 0); /* one is of single precision */
            if (step == 200) CHECK(peri_world_asleep(w, NULL) == 3 && peri_world_asleep(w, b[3]) == 0);
            woke |= peri_world_asleep(w, NULL) == 1 && peri_world_asleep(w, b[2]) == 1;
        }
        CHECK(woke);
        CHECK(mean_speed(b[1]) > 10);
        for (int k = 0; k < ROW; ++k) CHECK(same_motion(a[k], b[k]) && peri_time(a[k]) == peri_time(b[k]));
        row_drop(b, w), row_drop(a, v);
    }
}

/* A body that the caller sets down upon one that sleeps wakes it, as if it had been awake. */
static void who_is_set_down_wakes(void) {
    peri_body *b[2][ROW];
    peri_world *w[2] = {sleepy(1e-3, 1e-6, NULL), world_make()};
    const double still[2] = {-40, 0}, into[2] = {3.3e-3, 0}, more[2] = {1e-5, 0};
    double put_in[2], p[2], sum = 0, most = 0;
    peri_energy e[2];
    for (int n = 0; n < 2; ++n) {
        row_make(b[n], w[n], 1);
        (void)MUST(b[n][3], peri_add_velocity(b[n][3], PERI_ALL, still));
        (void)world_must(w[n], world_steps(w[n], 100));
        CHECK(peri_world_asleep(w[n], NULL) == (n ? 0 : ROW));
        (void)MUST(b[n][3], peri_add_displacement(b[n][3], PERI_ALL, into));
        (void)world_must(w[n], peri_world_get_energy(w[n], &e[n]));
        (void)MUST(b[n][3], peri_add_displacement(b[n][3], PERI_ALL, more)); /* too little for lists to be made anew */
        (void)world_must(w[n], peri_world_get_energy(w[n], &e[n]));
        put_in[n] = e[n].contact;
        (void)world_must(w[n], world_steps(w[n], 40));
        (void)world_must(w[n], peri_world_get_energy(w[n], &e[n]));
    }
    for (int k = 0; k < ROW; ++k) {
        CHECK(same_motion(b[0][k], b[1][k]));
        (void)MUST(b[0][k], peri_get_momentum(b[0][k], p, NULL));
        sum += p[0];
        most = fmax(most, fabs(p[0]));
    }
    CHECK(most > 0 && fabs(sum) < 1e-6 * most);
    CHECK(put_in[0] > 0 && put_in[0] == put_in[1]);
    CHECK(e[0].initial > 0 && e[0].initial == e[1].initial && e[0].error == e[1].error && e[0].contact == e[1].contact);
    CHECK(peri_world_asleep(w[0], b[0][2]) == 1 && peri_world_asleep(w[0], b[0][0]) == 0);
    for (int n = 0; n < 2; ++n) row_drop(b[n], w[n]);
}

/* ---- what wakes -------------------------------------------------------------------------------------------------------------------- */

static void change(int kind, peri_body *b, peri_world *w) {
    const double one[2] = {1e-9, 0}, from[2] = {3e-3, -1}, to[2] = {3e-3, 1};
    peri_advance_desc r;
    peri_contact_desc c;
    peri_obstacle_desc o;
    double v[48] = {1e-6};
    peri_advance_desc_init(&r), peri_contact_desc_init(&c), peri_obstacle_desc_init(&o, PERI_SHAPE_PLANE);
    r.steps = 1;
    o.normal[0] = 1, o.place[0] = -1;
    switch (kind) {
    case 0: (void)MUST(b, peri_add_velocity(b, PERI_ALL, one)); break;
    case 1: (void)MUST(b, peri_add_displacement(b, PERI_ALL, one)); break;
    case 2: (void)MUST(b, peri_set_field(b, PERI_FIELD_VELOCITY, v, 48)); break;
    case 3: (void)MUST(b, peri_apply_body_force(b, PERI_ALL, one, NULL, NULL)); break;
    case 4: (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_Y, NULL, NULL, NULL)); break;
    case 5: (void)MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to)); break;
    case 6: (void)MUST(b, peri_add_obstacle(b, &o)); break;
    case 7: (void)MUST(b, peri_set_contact(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c)); break;
    case 8: (void)MUST(b, peri_advance(b, &r)); break;
    case 9: (void)MUST(b, peri_reset(b)); break;
    case 10: (void)world_must(w, peri_world_remove(w, b)); break;
    case 11: peri_body_destroy(b); break;
    default: (void)world_must(w, peri_world_set_contact(w, NULL, NULL, &c));
    }
}

/* Whatever sets or changes a body wakes it with those it fell asleep with, and nobody else. */
static void changes_wake(void) {
    for (int kind = 0; kind < 13; ++kind) {
        peri_body *b[ROW], *copy;
        peri_world *w = sleepy(1e-3, 1e-6, NULL);
        double field[48];
        const double still[2] = {-40, 0};
        row_make(b, w, 1);
        (void)MUST(b[3], peri_add_velocity(b[3], PERI_ALL, still));
        (void)world_must(w, world_steps(w, 100));
        (void)MUST(b[0], peri_get_field(b[0], PERI_FIELD_FORCE_DENSITY, field, 48)); /* who reads wakes nobody */
        (void)MUST(b[0], peri_body_clone(b[0], &copy, NULL));
        CHECK(peri_world_asleep(w, NULL) == ROW);
        CHECK(peri_world_asleep(w, copy) == PERI_ERROR_ARGUMENT);
        peri_body_destroy(copy);
        change(kind, b[0], w);
        CHECK(peri_world_asleep(w, NULL) == (kind == 12 ? 0 : 2));
        CHECK(peri_world_asleep(w, b[1]) == 0 && peri_world_asleep(w, b[2]) == (kind != 12));
        (void)world_must(w, world_steps(w, 3));
        CHECK(peri_world_asleep(w, b[1]) == 0);
        (void)world_must(w, world_steps(w, 100)); /* and they sleep again */
        CHECK(peri_world_asleep(w, b[1]) == 1);
        if (kind == 11) b[0] = NULL;
        row_drop(b, w);
    }
}

/* ---- who does not sleep ------------------------------------------------------------------------------------------------------------ */

static int32_t nothing_yet(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)time, (void)points;
    for (int64_t k = 0; k < 2 * count; ++k) value[k] = 0;
    return 0;
}

/* Loads by callbacks, supports that move, obstacles that are free keep a body awake, and those that it touches, but not who is alone. */
static void what_varies_keeps_awake(void) {
    for (int kind = 0; kind < 3; ++kind) {
        peri_body *b[ROW];
        peri_world *w = sleepy(1e-3, 1e-6, NULL);
        const double still[2] = {-40, 0}, slow[2] = {0, 1e-9};
        peri_obstacle_desc ball;
        row_make(b, w, 1);
        (void)MUST(b[3], peri_add_velocity(b[3], PERI_ALL, still));
        peri_obstacle_desc_init(&ball, PERI_SHAPE_BALL);
        ball.radius = 1e-3, ball.place[1] = 1, ball.mass = 1;
        if (kind == 0) (void)MUST(b[0], peri_apply_body_force(b[0], PERI_ALL, slow, nothing_yet, NULL));
        if (kind == 1) (void)MUST(b[0], peri_prescribe_velocity(b[0], PERI_ALL, PERI_AXIS_Y, slow, NULL, NULL));
        if (kind == 2) (void)MUST(b[0], peri_add_obstacle(b[0], &ball));
        (void)world_must(w, world_steps(w, 200));
        CHECK(peri_world_asleep(w, b[0]) == 0 && peri_world_asleep(w, b[1]) == 0);
        CHECK(peri_world_asleep(w, b[2]) == 1 && peri_world_asleep(w, b[3]) == 1);
        row_drop(b, w);
    }
}

/* ---- cost -------------------------------------------------------------------------------------------------------------------------- */

static double seconds(peri_world *w, int64_t steps) {
    const clock_t begin = clock();
    (void)world_must(w, world_steps(w, steps));
    return (double)(clock() - begin) / CLOCKS_PER_SEC;
}

/* Processor time per step, of two blocks that touch: 50 steps awake, 50,000 asleep. */
static void sleep_costs_nothing(void) {
    bars s = bars_of(2, 3, 50, 50);
    peri_body *b[2] = {bar_at(&s, 0, 0), bar_at(&s, 50e-3, 0)};
    peri_world *w = sleepy(1e-3, 2e-5, NULL);
    for (int k = 0; k < 2; ++k) (void)world_must(w, peri_world_add(w, b[k]));
    (void)world_must(w, world_steps(w, 5));
    const double awake = seconds(w, 50) / 50;
    CHECK(peri_world_asleep(w, NULL) == 0);
    (void)world_must(w, world_for(w, 3e-5));
    CHECK(peri_world_asleep(w, NULL) == 2);
    const double asleep = seconds(w, 50000) / 50000;
    if (test_long) printf("    a step of 5000 points: awake %.2e s, asleep %.2e s: %.2e\n", awake, asleep, asleep / awake);
    CHECK(asleep <= 0.02 * awake);
    for (int k = 0; k < 2; ++k) peri_body_destroy(b[k]);
    peri_world_destroy(w);
}

/* ---- memory ------------------------------------------------------------------------------------------------------------------------ */

static void memory_may_fail(void) {
    int64_t calls = 1;
    for (int64_t fail = -1; fail < calls; fail += test_long || fail < 0 ? 1 : 3) {
        pool p = {0, 0, 0, 0, -1, 0};
        peri_body *b[ROW];
        peri_world *w = sleepy(1e-3, 1e-6, &p);
        row_make(b, w, 1);
        if (fail >= 0) p.fail_at = p.calls + fail;
        const int64_t first = p.calls;
        const int32_t status = world_steps(w, 900);
        CHECK(status == (fail < 0 ? PERI_OK : PERI_ERROR_MEMORY) || (fail >= 0 && status == PERI_OK));
        if (fail < 0) calls = p.calls - first;
        p.fail_at = -1;
        for (int k = 0; k < ROW; ++k) (void)MUST(b[k], peri_reset(b[k]));
        (void)world_must(w, world_steps(w, 100));
        CHECK(peri_world_asleep(w, NULL) == ROW);
        CHECK(peri_world_bytes(w) == p.bytes && p.wrong == 0);
        row_drop(b, w);
        CHECK(p.blocks == 0 && p.bytes == 0);
    }
    CHECK(calls > 20);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(a_stack_settles_and_sleeps);
    RUN(motion_that_ends_is_damping);
    RUN(the_struck_wake_in_that_step);
    RUN(who_is_set_down_wakes);
    RUN(changes_wake);
    RUN(what_varies_keeps_awake);
    RUN(sleep_costs_nothing);
    RUN(memory_may_fail);
    return test_end("test_world_sleep");
}
