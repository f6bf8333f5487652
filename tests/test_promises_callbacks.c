/* SPDX-License-Identifier: MIT */
/* test_promises_callbacks.c - sentences of docs/manual.md on callbacks and hooks that no other test is about. tests/promises says which
   sentence each case proves. SOURCE OF TRUTH: that sentence, quoted before each case. */
#include "refusal.h"
#include <setjmp.h>

static const double lo2[2] = {0, 0};

/* Unit cells, horizon 2.1, unit modulus and density. */
static specimen plate_of(int nx, int ny, double stretch) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.1, nx, ny, 1);
    s.material.critical_stretch = stretch;
    return s;
}
static peri_body *plate(int nx, int ny, double stretch) {
    const specimen s = plate_of(nx, ny, stretch);
    return specimen_make(&s);
}
static void pull_apart(peri_body *b, double speed) {
    const double hi[2] = {5, 99}, v[2] = {-speed, 0};
    MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi)), v));
}
static peri_advance_desc run_of(int64_t steps, peri_frame_fn frame, void *user) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = steps;
    a.on_frame = frame;
    a.user = user;
    return a;
}

/* ---- what callbacks may do ----------------------------------------------------------------------------------------- */

/* Calls that change a body but not its motion: their number that gives `code`, with field peri_unlock where that is PERI_ERROR_ORDER. */
static int lesser_changes(peri_body *b, int32_t code) {
    const double v[2] = {0, 0}, up[2] = {0, 1}, far_[2] = {0, -90}, from[2] = {3, 7}, to[2] = {3, 9};
    double product[2 * 80] = {0};
    peri_body *copy = NULL;
    int good = 0;
    const int32_t load = peri_id(b, PERI_KIND_LOAD, 1), wall = peri_id(b, PERI_KIND_OBSTACLE, 1);
#define TRY(call)                                                                                                      \
    do {                                                                                                               \
        const int64_t said = (call);                                                                                   \
        peri_error e;                                                                                                  \
        const int told = peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "peri_unlock") == 0;                      \
        if (code == PERI_OK ? said >= 0 : said == code && told) ++good;                                                \
        else printf("    %s: %d, %s\n", #call, (int)said, e.field);                                                    \
    } while (0)
    TRY(peri_cut_segment(b, PERI_CUT_NOW, from, to));
    TRY(peri_select_ball(b, NULL, lo2, 3));
    TRY(peri_set_no_fail(b, PERI_ALL, 1));
    TRY(peri_on_break(b, NULL, NULL));
    TRY(peri_apply_body_force(b, PERI_ALL, v, NULL, NULL));
    TRY(peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_Y, NULL, NULL, NULL));
    TRY(plane_obstacle(b, far_, up, 1, NULL, NULL));
    TRY(peri_remove_load(b, load));
    TRY(peri_remove_obstacle(b, wall));
    TRY(peri_multiply_stiffness(b, product, product, 2 * 80));
    TRY(peri_body_clone(b, &copy, &seen) < 0 ? seen.code : PERI_OK);
    peri_body_destroy(copy);
    return good;
}
enum { LESSER = 11, GREATER = 6 };
static int greater_changes(peri_body *b, int32_t code) {
    const double v[2] = {0, 0};
    double x[2 * 80] = {0};
    peri_advance_desc a = run_of(1, NULL, NULL);
    peri_solve_desc s;
    int good = 0;
    peri_solve_desc_init(&s);
    s.loose = PERI_LOOSE_PINNED;
    TRY(peri_add_displacement(b, PERI_ALL, v));
    TRY(peri_add_velocity(b, PERI_ALL, v));
    TRY(peri_set_field(b, PERI_FIELD_VELOCITY, x, 2 * 80));
    if (code == PERI_OK) return good + 3; /* a torn body does not run */
    TRY(peri_reset(b));
    TRY(peri_advance(b, &a));
    TRY(peri_solve(b, &s, NULL));
    return good;
}
static int readings(peri_body *b) {
    double x[2 * 80];
    peri_energy e;
    peri_view view;
    return (peri_get_field(b, PERI_FIELD_FORCE_DENSITY, x, 2 * 80) == PERI_OK) + (peri_get_energy(b, &e) == PERI_OK) +
           (peri_view_field(b, PERI_FIELD_DAMAGE, &view) == PERI_OK) + (peri_broken_count(b) >= 0) + (peri_bond_is_intact(b, 0, 1) >= 0);
}

typedef struct caller {
    peri_body *b;
    int        calls, bad, destroyed;
    jmp_buf    out;
} caller;
static void hear(void *user, int32_t level, const char *text) {
    if (level == 1 && strstr(text, "peri_body_destroy")) ((caller *)user)->destroyed++;
}
static int32_t in_frame(void *user, peri_body *b) {
    caller *c = (caller *)user;
    if (c->calls++) return 0;
    c->bad += readings(b) != 5 || greater_changes(b, PERI_ERROR_ORDER) != GREATER || lesser_changes(b, PERI_OK) != LESSER;
    peri_body_destroy(b);
    return 0;
}
static int32_t in_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    caller *c = (caller *)user;
    (void)time, (void)count, (void)points, (void)value;
    c->calls++;
    c->bad += readings(c->b) != 5 || greater_changes(c->b, PERI_ERROR_ORDER) != GREATER;
    c->bad += lesser_changes(c->b, PERI_ERROR_ORDER) != LESSER;
    peri_body_destroy(c->b);
    return 0;
}
static int32_t in_iteration(void *user, int64_t iteration, double residual) {
    (void)iteration, (void)residual;
    return in_load(user, 0, 0, NULL, NULL);
}
static peri_body *watched(caller *c) {
    const double v[2] = {1e-4, 0}, hi[2] = {2, 8}, far_[2] = {0, -50}, up[2] = {0, 1};
    specimen s = plate_of(10, 8, 0.5);
    memset(c, 0, sizeof *c);
    s.desc.log = hear;
    s.desc.log_user = c;
    peri_body *b = c->b = specimen_make(&s);
    MUST(b, peri_apply_body_force(b, PERI_ALL, v, NULL, NULL));
    MUST(b, plane_obstacle(b, far_, up, 1, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, "left", lo2, hi)), PERI_AXIS_XY, NULL, NULL, NULL));
    return b;
}
/* "on_frame and on_step come between steps: they may also cut, select, set no-fail zones, set peri_on_break, add and remove loads and
   obstacles, multiply by the stiffness, and clone. Any other change is refused with PERI_ERROR_ORDER" (field peri_unlock).
   "peri_body_destroy from a callback of the body is ignored; the log says so." */
static void frames_may_and_may_not(void) {
    caller c;
    peri_advance_desc a;
    peri_solve_desc s;
    peri_body *b = watched(&c);
    a = run_of(3, in_frame, &c);
    MUST(b, peri_advance(b, &a));
    CHECK(c.calls == 1 && c.bad == 0 && c.destroyed == 1);
    peri_body_destroy(b);
    b = watched(&c);
    peri_solve_desc_init(&s);
    s.on_step = in_frame;
    s.user = &c;
    MUST(b, peri_solve(b, &s, NULL));
    CHECK(c.calls == 2 && c.bad == 0 && c.destroyed == 1); /* it cut bonds: asked again at the equilibrium after that */
    peri_body_destroy(b);
}
/* "In any other callback [it may read]: every change of this body (peri_unlock)" is refused. */
static void callbacks_may_only_read(void) {
    const double v[2] = {1e-5, 0};
    caller c;
    peri_solve_desc s;
    peri_advance_desc a = run_of(3, NULL, NULL);
    peri_body *b = watched(&c);
    MUST(b, peri_apply_body_force(b, PERI_ALL, v, in_load, &c));
    MUST(b, peri_advance(b, &a));
    CHECK(c.calls >= 4 && c.bad == 0 && c.destroyed == c.calls);
    peri_body_destroy(b);
    b = watched(&c);
    peri_solve_desc_init(&s);
    s.on_iteration = in_iteration;
    s.user = &c;
    MUST(b, peri_solve(b, &s, NULL));
    CHECK(c.calls >= 4 && c.bad == 0 && c.destroyed == c.calls);
    peri_body_destroy(b);
}

static int32_t leave(void *user, peri_body *b) {
    (void)b;
    longjmp(((caller *)user)->out, 1);
    return 0;
}
static int32_t leave_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)time, (void)count, (void)points, (void)value;
    return leave(user, NULL);
}
static void run_and_leave(caller *c, peri_frame_fn frame) {
    peri_advance_desc a = run_of(3, frame, c);
    if (setjmp(c->out) == 0) MUST(c->b, peri_advance(c->b, &a));
}
/* "locked: reading, peri_unlock, and after a jump out of on_frame or on_step what these may do; every other change [is refused]
   (peri_unlock)"; "torn: all but runs; peri_advance, peri_solve (peri_reset)"; "the body runs again only after peri_reset". */
static void locked_and_torn_bodies(void) {
    for (int frame = 0; frame < 2; ++frame) {
        caller c;
        peri_solve_desc s;
        peri_advance_desc a = run_of(1, NULL, NULL);
        peri_body *b = watched(&c);
        const int32_t load = frame ? 0 : (int32_t)MUST(b, peri_apply_body_force(b, PERI_ALL, lo2, leave_load, &c));
        run_and_leave(&c, frame ? leave : NULL);
        CHECK(readings(b) == 5 && greater_changes(b, PERI_ERROR_ORDER) == GREATER);
        if (!frame) CHECK(lesser_changes(b, PERI_ERROR_ORDER) == LESSER);
        CHECK(peri_unlock(b) == PERI_OK);
        REFUSE(b, PERI_ERROR_ORDER, peri_unlock(b));
        FIELD_IS("peri_unlock");
        if (!frame) MUST(b, peri_remove_load(b, load));
        CHECK(readings(b) == 5 && greater_changes(b, PERI_OK) == GREATER && lesser_changes(b, PERI_OK) == LESSER);
        REFUSE(b, PERI_ERROR_ORDER, peri_advance(b, &a));
        CHECK(strcmp(seen.field, "peri_reset") == 0);
        peri_solve_desc_init(&s);
        REFUSE(b, PERI_ERROR_ORDER, peri_solve(b, &s, NULL));
        CHECK(strcmp(seen.field, "peri_reset") == 0);
        MUST(b, peri_reset(b));
        MUST(b, peri_advance(b, &a));
        peri_body_destroy(b);
    }
}

static int32_t build_another(void *user, double time, int64_t count, const int32_t *points, double *value) {
    peri_body *b = plate(10, 8, 0.05), *copy = NULL;
    peri_advance_desc a = run_of(5, NULL, NULL);
    (void)time, (void)count, (void)points, (void)value;
    pull_apart(b, 0.1);
    CHECK(peri_advance(b, &a) == PERI_OK && peri_body_clone(b, &copy, NULL) == PERI_OK && peri_reset(copy) == PERI_OK);
    peri_body_destroy(b);
    peri_body_destroy(copy);
    ++*(int *)user;
    return 0;
}
/* "Other bodies are free": built, run, cloned and destroyed from a callback, which leaves the bits of its own body. */
static void other_bodies_are_free(void) {
    const double v[2] = {1e-3, 0};
    double *u[2];
    int calls = 0;
    for (int k = 0; k < 2; ++k) {
        peri_body *b = plate(10, 8, 0.05);
        peri_advance_desc a = run_of(12, NULL, NULL);
        pull_apart(b, 0.1);
        MUST(b, peri_apply_body_force(b, PERI_ALL, v, k ? build_another : NULL, &calls));
        MUST(b, peri_advance(b, &a));
        u[k] = get(b, PERI_FIELD_DISPLACEMENT);
        peri_body_destroy(b);
    }
    CHECK(calls == 13 && memcmp(u[0], u[1], 160 * sizeof(double)) == 0);
    free(u[0]);
    free(u[1]);
}

/* ---- when, on which thread, with what ------------------------------------------------------------------------------ */

enum { ALLOCATE, RELEASE, LOG, POINT, PAIR, INFLUENCE, LOAD, MOTION, BREAK, FRAME, ITERATION, WRITE, KINDS };
static struct {
    int     tasks; /* under way */
    int64_t loops, calls[KINDS];
} jobs;
static int32_t note(int kind) {
    jobs.calls[kind]++;
    CHECK(jobs.tasks == 0);
    return 0;
}
static void loop(void *user, int64_t count, peri_task_fn task, void *context) {
    (void)user;
    jobs.loops++;
    jobs.tasks = 1;
    for (int64_t k = count; k-- > 0;) task(context, k);
    jobs.tasks = 0;
}
static void *take(void *user, uint64_t bytes) { return (void)user, (void)note(ALLOCATE), malloc((size_t)bytes); }
static void give(void *user, void *pointer, uint64_t bytes) { (void)user, (void)bytes, (void)note(RELEASE), free(pointer); }
static void on_log(void *user, int32_t level, const char *text) { (void)user, (void)level, (void)text, (void)note(LOG); }
static int32_t on_point(void *user, int64_t index, const double *x) { return (void)user, (void)index, (void)x, 1 + note(POINT); }
static int32_t on_pair(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    return (void)user, (void)i, (void)j, (void)xi, (void)xj, note(PAIR);
}
static int32_t on_influence(void *user, double q, double *w) { return *w = 1 - 0.5 * q, (void)user, note(INFLUENCE); }
static int32_t on_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    return (void)user, (void)time, (void)count, (void)points, (void)value, note(LOAD);
}
static int32_t on_motion(void *user, double time, double *place, double *turn) {
    return (void)user, (void)time, (void)place, (void)turn, note(MOTION);
}
static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    return (void)user, (void)i, (void)j, (void)time, (void)stretch, note(BREAK);
}
static int32_t on_frame(void *user, peri_body *b) { return (void)user, (void)b, note(FRAME); }
static int32_t on_iteration(void *user, int64_t iteration, double residual) {
    return (void)user, (void)iteration, (void)residual, note(ITERATION);
}
static int32_t on_write(void *user, const void *bytes, int64_t count) { return (void)user, (void)bytes, (void)count, note(WRITE); }

/* "Thread: of the call", of every callback: with a job system of ours they never come while its tasks are under way, and all of the work
   that is shared goes through it, "its tasks where you like": here backwards. */
static void callbacks_come_outside_of_tasks(void) {
    const double nowhere[2] = {-5, -5}, gone[2] = {-5, -6}, up[2] = {0, 1}, below[2] = {0, -20}, v[2] = {1e-6, 0};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3, 70, 65, 1); /* 120,000 entries: worth sharing */
    peri_advance_desc a = run_of(4, on_frame, NULL);
    peri_solve_desc st;
    memset(&jobs, 0, sizeof jobs);
    s.material.critical_stretch = 0.01;
    s.desc.parallel_for = loop;
    s.desc.allocate = take;
    s.desc.release = give;
    s.desc.log = on_log;
    s.desc.influence = PERI_INFLUENCE_USER;
    s.desc.influence_fn = on_influence;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1, on_point, NULL));
    MUST(b, peri_build(b));
    MUST(b, peri_select_if(b, NULL, on_point, NULL));
    MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, on_pair, NULL));
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, nowhere, gone));
    MUST(b, peri_apply_body_force(b, PERI_ALL, v, on_load, NULL));
    MUST(b, plane_obstacle(b, below, up, 1e-3, on_motion, NULL));
    MUST(b, peri_on_break(b, on_break, NULL));
    pull_apart(b, 0.5);
    MUST(b, peri_advance(b, &a));
    peri_solve_desc_init(&st);
    st.loose = PERI_LOOSE_PINNED;
    st.iterations = 2;
    st.halvings = 0;
    st.on_iteration = on_iteration;
    REFUSE(b, PERI_ERROR_CONVERGENCE, peri_solve(b, &st, NULL));
    MUST(b, peri_export_vtu_to(b, on_write, NULL));
    peri_body_destroy(b);
    for (int k = 0; k < KINDS; ++k) CHECK(jobs.calls[k] > 0);
    CHECK(jobs.loops > 20);
}

/* peri_influence_fn "is called by peri_build, peri_plan and peri_get_bond_constants only". */
static void influence_is_not_asked_later(void) {
    const double v[2] = {1e-6, 0};
    specimen s = plate_of(10, 8, 0.01);
    double c, u[160];
    peri_advance_desc a = run_of(9, NULL, NULL);
    peri_solve_desc st;
    peri_plan_desc p;
    peri_plan_report report;
    int64_t count;
    s.desc.influence = PERI_INFLUENCE_USER;
    s.desc.influence_fn = on_influence;
    memset(&jobs, 0, sizeof jobs);
    peri_body *b = specimen_start(&s), *copy = NULL;
    const int32_t id = peri_id(b, PERI_KIND_MATERIAL, 1);
    MUST(b, peri_add_box(b, id, s.lo, s.hi, 1));
    CHECK(jobs.calls[INFLUENCE] == 0);
    MUST(b, peri_get_bond_constants(b, id, id, &c, NULL));
    count = jobs.calls[INFLUENCE];
    CHECK(count > 0);
    MUST(b, peri_build(b));
    CHECK(jobs.calls[INFLUENCE] > count);
    count = jobs.calls[INFLUENCE];
    pull_apart(b, 0.2);
    MUST(b, peri_advance(b, &a));
    CHECK(peri_broken_count(b) > 0);
    MUST(b, peri_body_clone(b, &copy, NULL));
    MUST(b, peri_apply_layer_traction(b, PERI_ALL, 1, v, NULL, NULL));
    peri_solve_desc_init(&st);
    st.loose = PERI_LOOSE_PINNED;
    MUST(b, peri_reset(b));
    MUST(b, peri_solve(b, &st, NULL));
    for (int32_t field = PERI_FIELD_POSITION; field < PERI_FIELD_STRAIN; ++field) MUST(b, peri_get_field(b, field, u, 160));
    MUST(b, peri_multiply_stiffness(b, u, u, 160));
    CHECK(jobs.calls[INFLUENCE] == count);
    peri_plan_desc_init(&p);
    p.body = &s.desc;
    p.material = &s.material;
    p.spacing = 1;
    p.hi[0] = p.hi[1] = 9;
    CHECK(peri_plan(&p, &report, NULL) == PERI_OK && jobs.calls[INFLUENCE] > count);
    peri_body_destroy(b);
    peri_body_destroy(copy);
}

static double q_range[2];
static int32_t note_q(void *user, double q, double *w) {
    (void)user;
    q_range[0] = fmin(q_range[0], q);
    q_range[1] = fmax(q_range[1], q);
    *w = 1;
    return 0;
}
/* "w(q), dimensionless, q > 0; with partial volumes q goes a little beyond 1, for cells whose centre lies outside": up to half a
   diagonal. */
static void influence_is_asked_beyond_the_horizon(void) {
    for (int k = 0; k < 4; ++k) {
        specimen s = specimen_of(k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1e-3, 2.3, 7, 6, 6);
        q_range[0] = 9, q_range[1] = 0;
        s.desc.influence = PERI_INFLUENCE_USER;
        s.desc.influence_fn = note_q;
        s.desc.quadrature = k / 2 ? PERI_QUADRATURE_PARTIAL : PERI_QUADRATURE_FULL;
        peri_body_destroy(specimen_make(&s));
        CHECK(q_range[0] > 0 && q_range[1] > 0.9);
        if (k / 2) CHECK(q_range[1] > 1.05 && q_range[1] < 1 + 0.5 * sqrt(3.0) / 2.3);
        else CHECK(q_range[1] <= 1 + 1e-8);
    }
}

typedef struct heard {
    int  count[2], other;
    char text[2][200];
} heard;
static void remember(void *user, int32_t level, const char *text) {
    heard *h = (heard *)user;
    if (level != 0 && level != 1) h->other++;
    else h->count[level]++, (void)snprintf(h->text[level], sizeof h->text[level], "%s", text);
}
static int32_t destroy_in_frame(void *user, peri_body *b) {
    (void)user;
    peri_body_destroy(b);
    return 0;
}
/* "peri_log_fn: remarks that are no errors, as a time step that was forced, a crack that meets no bond, families that the moment correction
   can only approach, a destroy from a callback. Level 0 is information, 1 a warning." A step forced: "the log says so"; "0 bonds where the
   crack misses; the log says so". */
static void remarks(void) {
    const double nowhere[2] = {-5, -5}, gone[2] = {-5, -6};
    specimen s = plate_of(10, 8, 0);
    heard h;
    peri_advance_desc a = run_of(1, NULL, NULL);
    s.desc.log = remember;
    s.desc.log_user = &h;
    memset(&h, 0, sizeof h);
    peri_body *b = specimen_make(&s);
    a.time_step = 0.9 * peri_stable_step(b);
    MUST(b, peri_advance(b, &a));
    CHECK(h.count[0] == 0 && h.count[1] == 0);
    a.force_step = 1;
    MUST(b, peri_advance(b, &a)); /* allowed, and not needed */
    CHECK(h.count[1] == 0);
    a.time_step = 1.1 * peri_stable_step(b);
    MUST(b, peri_advance(b, &a));
    CHECK(h.count[1] == 1 && strstr(h.text[1], "forced"));
    CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_NOW, nowhere, gone)) == 0 && h.count[1] == 2 && strstr(h.text[1], "meets no bond"));
    a = run_of(1, destroy_in_frame, NULL);
    MUST(b, peri_advance(b, &a));
    CHECK(h.count[1] == 3 && strstr(h.text[1], "ignored") && h.count[0] == 0);
    peri_body_destroy(b);
    s.desc.correction = PERI_CORRECTION_MOMENT;
    s.desc.horizon = 1.5; /* corners of few bonds */
    b = specimen_make(&s);
    CHECK(h.count[0] == 1 && strstr(h.text[0], "moment correction") && h.other == 0);
    peri_body_destroy(b);
}

static int32_t spoil_third(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)points;
    if (time > 0.5 && count > 2) value[2 * 2 + 1] = *(const double *)user;
    return 0;
}
/* "A callback that writes a number that is not finite ends the call in the same way; the index is then the point, and the value that
   number". */
static void what_is_not_finite_is_told(void) {
    const double wrong[3] = {(double)NAN, HUGE_VAL, -HUGE_VAL};
    const int32_t chosen[4] = {70, 5, 33, 41};
    for (int k = 0; k < 3; ++k) {
        peri_body *b = plate(10, 8, 0);
        peri_advance_desc a = run_of(9, NULL, NULL);
        double spoilt = wrong[k];
        MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_points(b, NULL, 4, chosen)), lo2, spoil_third, &spoilt));
        a.time_step = 0.4;
        REFUSE(b, PERI_ERROR_CALLBACK, peri_advance(b, &a));
        CHECK(seen.index == 41 && (k ? seen.value == spoilt : seen.value != seen.value));
        peri_body_destroy(b);
    }
}

typedef struct reader {
    peri_body *b;
    int        calls;
    double     time[8], u[8], v[8];
} reader;
static int32_t read_motion(void *user, double time, int64_t count, const int32_t *points, double *value) {
    reader *r = (reader *)user;
    double x[160];
    (void)count, (void)points, (void)value;
    r->time[r->calls] = time;
    CHECK(peri_get_field(r->b, PERI_FIELD_DISPLACEMENT, x, 160) == PERI_OK);
    r->u[r->calls] = x[0];
    CHECK(peri_get_field(r->b, PERI_FIELD_VELOCITY, x, 160) == PERI_OK);
    r->v[r->calls++] = x[0];
    return 0;
}
/* "It may read it; within a step, forces and velocities are those under way": of a body that falls by g, for the time of a step's end, half
   a kick after its start: velocity-Verlet. */
static void reading_within_a_step(void) {
    const double g = 0.01, dt = 0.25, fall[2] = {g, 0};
    reader r;
    peri_advance_desc a = run_of(4, NULL, NULL);
    peri_body *b = plate(10, 8, 0);
    memset(&r, 0, sizeof r);
    r.b = b;
    MUST(b, peri_apply_body_force(b, PERI_ALL, fall, read_motion, &r));
    a.time_step = dt;
    MUST(b, peri_advance(b, &a));
    CHECK(r.calls == 5);
    for (int k = 1; k < 5; ++k) {
        CHECK_NEAR(r.time[k], k * dt, 1e-14, 0);
        CHECK_NEAR(r.u[k], 0.5 * g * k * k * dt * dt, 1e-13, 0);
        CHECK_NEAR(r.v[k], g * (k - 0.5) * dt, 1e-13, 0);
    }
    peri_body_destroy(b);
}

typedef struct asked {
    int    calls, wrong;
    double time, place;
} asked;
static int32_t ask_time(void *user, double time, int64_t count, const int32_t *points, double *value) {
    asked *k = (asked *)user;
    (void)count, (void)points;
    k->calls++;
    k->time = time;
    k->wrong += value[0] != 1e-6; /* the constant, without the load factor */
    return 0;
}
static int32_t note_place(void *user, double time, double *place, double *turn) {
    (void)turn;
    asked *k = (asked *)user;
    k->calls++;
    k->time = time;
    k->wrong += place[0] != 3 || place[1] != k->place;
    place[1] = k->place - 1e-3 * time;
    return 0;
}
/* "time that callbacks get: peri_time in motion; in peri_solve, and for reads after it until the next peri_advance, the load factor";
   peri_motion_fn: "`place` holds the place at which the obstacle was added"; peri_get_obstacle_force: "at the present time". */
static void times_of_callbacks(void) {
    const double pull[2] = {1e-6, 0}, hi[2] = {2, 8}, at[2] = {3, 0.25}, up[2] = {0, 1};
    double f[160], force[2];
    asked load = {0, 0, -1, 0}, wall = {0, 0, -1, 0.25};
    peri_advance_desc a = run_of(3, NULL, NULL);
    peri_solve_desc s;
    peri_body *b = plate(10, 8, 0);
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo2, hi)), PERI_AXIS_XY, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, pull, ask_time, &load));
    const int32_t plane = (int32_t)MUST(b, plane_obstacle(b, at, up, 1e-3, note_place, &wall));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 160));
    CHECK(load.calls > 0 && load.time == 0 && wall.time == 0);
    peri_solve_desc_init(&s);
    s.load_to = 0.4;
    MUST(b, peri_solve(b, &s, NULL));
    CHECK(load.time == 0.4 && wall.time == 0.4 && peri_time(b) == 0);
    for (int k = 0; k < 2; ++k) { /* after a change, forces are made anew */
        const double want = k ? peri_time(b) : 0.4;
        load.time = wall.time = -1;
        load.calls = 0;
        MUST(b, peri_add_displacement(b, PERI_ALL, lo2));
        MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 160));
        MUST(b, peri_get_obstacle_force(b, plane, force, NULL));
        CHECK(load.calls > 0 && load.time == want && wall.time == want);
        if (k == 0) MUST(b, peri_advance(b, &a));
        CHECK_NEAR(load.time, peri_time(b), 1e-14, 0);
    }
    CHECK(peri_time(b) > 0 && load.wrong == 0 && wall.wrong == 0);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(frames_may_and_may_not);
    RUN(callbacks_may_only_read);
    RUN(locked_and_torn_bodies);
    RUN(other_bodies_are_free);
    RUN(callbacks_come_outside_of_tasks);
    RUN(influence_is_not_asked_later);
    RUN(influence_is_asked_beyond_the_horizon);
    RUN(remarks);
    RUN(what_is_not_finite_is_told);
    RUN(reading_within_a_step);
    RUN(times_of_callbacks);
    return test_end("test_promises_callbacks");
}
