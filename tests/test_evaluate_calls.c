/* SPDX-License-Identifier: MIT */
/* peri_evaluate and peri_multiply_stiffness_at where they are refused.

   SOURCE OF TRUTH: peri.h: a status, the field, the place; and nothing is changed, lost or leaked. */
#include "refusal.h"
#include "restart_scene.h"

enum { MOST = 600 };
static int32_t swell(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)points;
    for (int64_t k = 0; k < count; ++k) value[2 * k] = 0.05 * sin(0.3 * time), value[2 * k + 1] = -0.02 * time;
    return 0;
}

static void wrong_calls_change_nothing(void) {
    static double u[MOST], f[MOST];
    const scene s = scene_of(PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, 0);
    peri_body *b = scene_make(&s), *still = NULL;
    const int64_t dofs = peri_point_count(b) * 2;
    peri_evaluate_desc e, good;
    peri_evaluate_report r;
    scene_run(b, 30);
    (void)MUST(NULL, peri_body_clone(b, &still, NULL));
    peri_evaluate_desc_init(&good);
    good.displacement = u, good.velocity = u, good.force = f, good.impulse = f, good.time_step = 0.1, good.fracture = 1;
#define WRONG(status, name, spoil)                                                                                     \
    do {                                                                                                               \
        e = good, spoil;                                                                                               \
        REFUSE(b, status, peri_evaluate(b, &e, &r));                                                                   \
        FIELD_IS(name);                                                                                                \
    } while (0)
    WRONG(PERI_ERROR_DESCRIPTOR, "desc", e.cookie++);
    WRONG(PERI_ERROR_CHOICE, "nodal", e.nodal = 2);
    WRONG(PERI_ERROR_CHOICE, "bonds", e.bonds = -1);
    WRONG(PERI_ERROR_CHOICE, "external", e.external = 2);
    WRONG(PERI_ERROR_CHOICE, "fracture", e.fracture = 2);
    WRONG(PERI_ERROR_CHOICE, "energy", e.energy = 2);
    WRONG(PERI_ERROR_CHOICE, "type", e.type = PERI_TYPE_I32);
    WRONG(PERI_ERROR_ARGUMENT, "point_stride", e.point_stride = -1);
    WRONG(PERI_ERROR_ARGUMENT, "component_stride", e.component_stride = -1);
    WRONG(PERI_ERROR_RANGE, "time_step", e.time_step = -1);
    WRONG(PERI_ERROR_RANGE, "time", e.time = HUGE_VAL);
    WRONG(PERI_ERROR_RANGE, "load_factor", e.load_factor = -HUGE_VAL);
    WRONG(PERI_ERROR_ARGUMENT, "bonds", e.bonds = 0);
    WRONG(PERI_ERROR_ARGUMENT, "bonds", (e.bonds = e.external = e.fracture = 0));
    WRONG(PERI_ERROR_ARGUMENT, "fracture", e.fracture = 0);
    WRONG(PERI_ERROR_ARGUMENT, "velocity", e.velocity = NULL);
    WRONG(PERI_ERROR_ARGUMENT, "impulse", e.impulse = NULL);
    WRONG(PERI_ERROR_ARGUMENT, "time_step", e.time_step = 0);
    WRONG(PERI_ERROR_RANGE, "displacement", u[17] = NAN);
    CHECK(seen.index == 8);
    u[17] = 1e17;
    WRONG(PERI_ERROR_RANGE, "displacement", (e.fracture = 0, e.velocity = NULL, e.impulse = NULL, e.time_step = 0));
    CHECK(seen.index == 8 && seen.value == 1e17);
    u[17] = 1e12; /* within 1e15 spacings, beyond 1e9 speeds of sound */
    WRONG(PERI_ERROR_RANGE, "velocity", (void)0);
    u[17] = 0;
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_evaluate(b, NULL, &r));
    REFUSE(b, PERI_ERROR_ARGUMENT, peri_multiply_stiffness_at(b, NULL, u, f, dofs));
    REFUSE(b, PERI_ERROR_CAPACITY, peri_multiply_stiffness_at(b, u, u, f, dofs - 1));
    u[5] = -HUGE_VAL;
    REFUSE(b, PERI_ERROR_RANGE, peri_multiply_stiffness_at(b, u, f, f, dofs));
    FIELD_IS("displacement");
    CHECK(peri_evaluate(NULL, &good, &r) == PERI_ERROR_ARGUMENT);
    peri_evaluate_desc_init(NULL);
    CHECK(same_state(b, still));
    peri_body_destroy(b);
    peri_body_destroy(still);
}

static int64_t grants; /* of memory, until none is given */
static void *grant(void *user, uint64_t bytes) {
    (void)user;
    return grants-- > 0 ? malloc((size_t)bytes) : NULL;
}
static void take_back(void *user, void *pointer, uint64_t bytes) {
    (void)user, (void)bytes;
    free(pointer);
}

/* Each allocation fails once: the call says so, and is as good as ever afterwards. */
static void short_memory(void) {
    double u[MOST], f[MOST], p[MOST];
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 2.1, 8, 6, 0);
    s.desc.allocate = grant;
    s.desc.release = take_back;
    for (int call = 0; call < 2; ++call) {
        grants = 1000000;
        peri_body *b = specimen_make(&s);
        const double centre[2] = { 4, -1 };
        peri_evaluate_desc e;
        (void)MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, swell, NULL));
        (void)MUST(b, ball_obstacle(b, centre, 1.2, 0, swing, NULL));
        shape_of(u, 96, 0.01);
        shape_of(p, 96, 1);
        peri_evaluate_desc_init(&e);
        e.displacement = u, e.force = f;
        int32_t status = PERI_ERROR_MEMORY;
        int64_t most = 0;
        for (; status == PERI_ERROR_MEMORY && most < 20; ++most) {
            grants = most;
            status = call ? peri_multiply_stiffness_at(b, u, p, f, 96) : peri_evaluate(b, &e, NULL);
        }
        CHECK(status == PERI_OK && most > 3);
        peri_body_destroy(b);
    }
}

/* The first call takes its vectors, u, f and the response with their margins; later ones nothing. */
static void memory_is_taken_once(void) {
    const scene s = scene_of(PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_PRECISION_DOUBLE, 0);
    peri_body *b = scene_make(&s);
    peri_evaluate_desc e;
    peri_memory m[4];
    double f[MOST];
    peri_evaluate_desc_init(&e);
    e.force = f;
    for (int k = 0; k < 4; ++k) {
        if (k) (void)MUST(b, peri_evaluate(b, &e, NULL));
        (void)MUST(b, peri_get_memory(b, &m[k]));
        e.fracture = k == 1;
    }
    CHECK(m[1].state >= m[0].state + 5 * 60 * 8 && m[1].total - m[0].total == m[1].state - m[0].state);
    CHECK(memcmp(&m[2], &m[1], sizeof m[1]) == 0 && memcmp(&m[3], &m[1], sizeof m[1]) == 0);
    peri_body_destroy(b);
}

/* An obstacle that pushes beyond the precision: the body is where it was, and whole. */
static void an_obstacle_beyond_the_precision(void) {
    double u[MOST], now[MOST];
    const double centre[2] = { 4, 3 };
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.1, 8, 6, 0);
    s.desc.precision = PERI_PRECISION_SINGLE;
    s.material.critical_stretch = 0.01;
    peri_body *b = specimen_make(&s);
    (void)MUST(b, ball_obstacle(b, centre, 3, 1e39, NULL, NULL));
    peri_evaluate_desc e;
    shape_of(u, 96, 0.5);
    peri_evaluate_desc_init(&e);
    e.displacement = u;
    e.fracture = 1;
    REFUSE(b, PERI_ERROR_RANGE, peri_evaluate(b, &e, NULL));
    FIELD_IS("stiffness");
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, now, 96));
    CHECK(largest(now, 96) == 0 && peri_broken_count(b) == 0);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(wrong_calls_change_nothing);
    RUN(short_memory);
    RUN(memory_is_taken_once);
    RUN(an_obstacle_beyond_the_precision);
    return test_end("test_evaluate_calls");
}
