/* SPDX-License-Identifier: MIT */
/* test_implicit.c - implicit dynamics.

   SOURCE OF TRUTH: the lowest mode of the assembled stiffness, which swings as cos(w t), and under the average acceleration as
   cos(n 2 atan(w h/2)) (Hughes 2000, 9.1.3); conservation of energy; order 2 of the method (Chung, Hulbert 1993); equilibria, where loads
   grow slowly. */
#include "solid.h"
#include "equilibrium.h"
#include "pool.h"

typedef struct bar { /* held at its left end */
    peri_body *body;
    double    *mode, w; /* the lowest, and its frequency */
    int64_t    n;
} bar;

static void bar_of(bar *p, int32_t geometry, int nx, int ny, double limit) {
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
    specimen q;
    s.geometry = geometry;
    s.ratio = 2;
    q = solid_specimen(&s, nx, ny, 1);
    if (limit > 0) q.material.critical_stretch = limit;
    p->body = specimen_make(&q);
    p->mode = NULL;
    p->n = 2 * peri_point_count(p->body);
    (void)MUST(p->body, peri_prescribe_displacement(p->body, slab(p->body, 0, 0, 2 * H), PERI_AXIS_XY, NULL, NULL, NULL));
}
static void find_mode(bar *p) {
    double *a = dense_stiffness(p->body, &p->n), *held = get(p->body, PERI_FIELD_HELD), *mass = get(p->body, PERI_FIELD_MASS), size = 1;
    unsigned char *fixed = (unsigned char *)calloc((size_t)p->n, 1);
    int64_t k;
    int turn;
    for (k = 0; k < p->n; ++k) fixed[k] = held[k] != 0;
    CHECK(factorise(a, p->n, fixed));
    p->mode = random_field(p->n, 1, 5);
    for (k = 0; k < p->n; ++k) p->mode[k] *= !fixed[k];
    for (turn = 0; turn < 200; ++turn) {
        size = norm(p->mode, p->n);
        for (k = 0; k < p->n; ++k) p->mode[k] /= size;
        substitute(a, p->n, p->mode);
    }
    size = norm(p->mode, p->n);
    p->w = sqrt(1 / size / mass[0]);
    for (k = 0; k < p->n; ++k) p->mode[k] *= 1e-3 * H / size;
    free(a);
    free(held);
    free(mass);
    free(fixed);
}
static void close_bar(bar *p) {
    peri_body_destroy(p->body);
    free(p->mode);
}
static peri_advance_desc steps_of(double step, int64_t steps) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.time_step = step;
    r.steps = steps;
    return r;
}
static peri_solve_report swing(peri_body *b, double step, int64_t steps, double rho, double tolerance) {
    const peri_advance_desc r = steps_of(step, steps);
    const peri_solve_desc s = statics_of(tolerance);
    peri_solve_report report;
    memset(&report, 0, sizeof report);
    (void)MUST(b, peri_advance_implicit(b, &r, &s, rho, &report));
    CHECK(report.steps == steps);
    return report;
}
static peri_energy energy_of(peri_body *b) {
    peri_energy e;
    memset(&e, 0, sizeof e);
    (void)MUST(b, peri_get_energy(b, &e));
    return e;
}

static double last_along(bar *p) {
    double *u = get(p->body, PERI_FIELD_DISPLACEMENT), last = u[p->n - 2];
    free(u);
    return last;
}

/* The mode at the end of `steps` steps that take 1.3 periods, in units of itself; whatever else moves is an error, too. */
static double off_mode(bar *p, int64_t steps, double rho, double *cosine) {
    const double time = 1.3 * 2 * 3.14159265358979323846 / p->w, h = time / (double)steps;
    double *u, worst;
    int64_t k;
    (void)MUST(p->body, peri_reset(p->body));
    put(p->body, PERI_FIELD_DISPLACEMENT, p->mode);
    (void)swing(p->body, h, steps, rho, 1e-11);
    CHECK(fabs(peri_time(p->body) - time) <= 1e-12 * time);
    u = get(p->body, PERI_FIELD_DISPLACEMENT);
    *cosine = 0;
    for (k = 0; k < p->n; ++k) *cosine += u[k] * p->mode[k] / norm(p->mode, p->n) / norm(p->mode, p->n);
    for (k = 0; k < p->n; ++k) u[k] -= cos(p->w * time) * p->mode[k];
    worst = norm(u, p->n) / norm(p->mode, p->n);
    free(u);
    return worst;
}
static void order_is_two(void) {
    static const double rho[4] = {1, 0.8, 0.4, 0};
    bar p;
    int k;
    bar_of(&p, PERI_GEOMETRY_LINEAR, 12, 4, 0);
    find_mode(&p);
    for (k = 0; k < 4; ++k) {
        double cosine, coarse = off_mode(&p, 100, rho[k], &cosine), fine = off_mode(&p, 200, rho[k], &cosine);
        const double order = log(coarse / fine) / log(2.0), h = 1.3 * 2 * 3.14159265358979323846 / p.w / 200;
        CHECK_NEAR(order, 2.0, 0, 0.1);
        if (k == 0) CHECK_NEAR(cosine, cos(200 * 2 * atan(0.5 * p.w * h)), 0, 1e-7);
    }
    close_bar(&p);
}

/* One call of many steps, and many of one: at rho = 1 the acceleration is that of the forces at every step. */
static void calls_go_on(void) {
    bar p;
    double *u, *w, h;
    int k;
    bar_of(&p, PERI_GEOMETRY_LINEAR, 12, 4, 0);
    find_mode(&p);
    h = 0.1 / p.w;
    put(p.body, PERI_FIELD_DISPLACEMENT, p.mode);
    (void)swing(p.body, h, 20, 1, 1e-11);
    u = get(p.body, PERI_FIELD_DISPLACEMENT);
    (void)MUST(p.body, peri_reset(p.body));
    put(p.body, PERI_FIELD_DISPLACEMENT, p.mode);
    for (k = 0; k < 20; ++k) (void)swing(p.body, h, 1, 1, 1e-11);
    w = get(p.body, PERI_FIELD_DISPLACEMENT);
    CHECK(furthest(u, w, p.n) <= 1e-8 * norm(p.mode, p.n));
    free(u);
    free(w);
    close_bar(&p);
}

/* At 100 times the stable step, from noise: it stays bounded, and rho = 1 keeps the energy. */
static void stable_and_conserving(void) {
    static const double rho[3] = {1, 0.5, 0};
    bar p;
    double *v, *held;
    int64_t i;
    int k;
    bar_of(&p, PERI_GEOMETRY_LINEAR, 16, 6, 0);
    v = random_field(p.n, 1, 17);
    held = get(p.body, PERI_FIELD_HELD);
    for (i = 0; i < p.n; ++i) v[i] = held[i] != 0 ? 0 : v[i];
    for (k = 0; k < 3; ++k) {
        peri_energy e;
        double whole;
        (void)MUST(p.body, peri_reset(p.body));
        put(p.body, PERI_FIELD_VELOCITY, v);
        (void)swing(p.body, 100 * peri_stable_step(p.body), 60, rho[k], 1e-10);
        e = energy_of(p.body);
        whole = e.kinetic + e.elastic;
        CHECK(whole <= e.initial * (1 + 1e-6));
        if (k == 0) CHECK_NEAR(whole, e.initial, 0, 1e-6 * e.initial);
        else CHECK(whole < 0.9 * e.initial);
        CHECK_NEAR(e.error, e.initial - whole, 0, 1e-9 * e.initial);
    }
    (void)MUST(p.body, peri_reset(p.body)); /* no mode is resolved: in 60 steps amplitudes fall by some 0.5^60 */
    put(p.body, PERI_FIELD_VELOCITY, v);
    (void)swing(p.body, 1e5 * peri_stable_step(p.body), 60, 0.5, 1e-10);
    CHECK(energy_of(p.body).kinetic + energy_of(p.body).elastic < 1e-9 * energy_of(p.body).initial);
    free(v);
    free(held);
    close_bar(&p);
}

/* Loads in time, a grip that is moved, damping: the ledger closes, and the reaction is what moves the mass. */
static int32_t puff(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)points;
    for (k = 0; k < count; ++k) value[2 * k + 1] = 1e-6 * sin(time / *(const double *)user);
    return 0;
}
static void ledger_closes(void) {
    static const double still[2] = {0, 0};
    int kind;
    for (kind = 0; kind < 2; ++kind) {
        bar p;
        double scale, step, push[2] = {0, 0}, moved;
        peri_advance_desc r;
        peri_energy e;
        bar_of(&p, PERI_GEOMETRY_LINEAR, 12, 4, 0);
        step = 30 * peri_stable_step(p.body);
        scale = 5 * step;
        push[0] = kind ? 1e-3 * H / (40 * step) : 1e-3 * H;
        (void)MUST(p.body, peri_apply_body_force(p.body, slab(p.body, 0, 6 * H, 9 * H), still, puff, &scale));
        if (kind) (void)MUST(p.body, peri_prescribe_velocity(p.body, slab(p.body, 0, 10 * H, 12 * H), PERI_AXIS_X, push, NULL, NULL));
        else (void)MUST(p.body, peri_prescribe_displacement(p.body, slab(p.body, 0, 10 * H, 12 * H), PERI_AXIS_X, push, NULL, NULL));
        r = steps_of(step, 40);
        r.damping = 0.02 / step;
        (void)MUST(p.body, peri_advance_implicit(p.body, &r, NULL, 1.0, NULL));
        e = energy_of(p.body);
        moved = last_along(&p);
        CHECK_NEAR(moved, 1e-3 * H, 0, kind ? 0.02e-3 * H : 1e-15);
        CHECK(e.damping > 0 && e.external > 0);
        CHECK_NEAR(e.error, 0, 0, 1e-6 * e.external);
        close_bar(&p);
    }
}

/* Large turns: steps of h, h/2 and h/4 come together by factors of 4. */
static void order_holds_in_large_motion(void) {
    double *u[3], first, second;
    bar p;
    int k;
    int64_t i;
    bar_of(&p, PERI_GEOMETRY_NONLINEAR, 12, 4, 0);
    find_mode(&p);
    for (k = 0; k < 3; ++k) {
        double *v = (double *)calloc((size_t)p.n, sizeof *v);
        const double time = 0.4 * 2 * 3.14159265358979323846 / p.w;
        for (i = 0; i < p.n; ++i) v[i] = 3e3 * p.w * p.mode[i];
        (void)MUST(p.body, peri_reset(p.body));
        put(p.body, PERI_FIELD_VELOCITY, v);
        (void)swing(p.body, time / (100 << k), 100 << k, 1, 1e-10);
        u[k] = get(p.body, PERI_FIELD_DISPLACEMENT);
        free(v);
    }
    first = furthest(u[0], u[1], p.n);
    second = furthest(u[1], u[2], p.n);
    CHECK(norm(u[2], p.n) > H); /* large */
    CHECK_NEAR(log(first / second) / log(2.0), 2.0, 0, 0.1);
    for (k = 0; k < 3; ++k) free(u[k]);
    close_bar(&p);
}

/* A load that grows over 30 periods, bending a strip on two supports: 1/20 of what explicit steps cost, and the equilibrium in the end. */
static int32_t grow(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const double part = fmin(time / *(const double *)user, 1);
    int64_t k;
    (void)points;
    for (k = 0; k < count; ++k) value[2 * k + 1] *= part * part * (3 - 2 * part);
    return 0;
}
static void slow_loads_cost_little(void) {
    const double push[2] = {0, -1e-7};
    double *u[2], duration = 0;
    peri_solve_report r;
    int64_t n = 0;
    int k;
    for (k = 0; k < 2; ++k) {
        bar p;
        bar_of(&p, PERI_GEOMETRY_LINEAR, 60, 6, 0);
        if (k == 0) duration = 30 * (60 * H) * (60 * H) / (6 * H * sqrt(YOUNG / DENSITY)); /* a period is some L^2/(thickness c) */
        (void)MUST(p.body, peri_prescribe_displacement(p.body, slab(p.body, 0, 58 * H, 60 * H), PERI_AXIS_Y, NULL, NULL, NULL));
        (void)MUST(p.body, peri_apply_body_force(p.body, slab(p.body, 0, 29 * H, 31 * H), push, k ? NULL : grow, k ? NULL : &duration));
        n = p.n;
        if (k == 0) {
            const double passes = duration / (0.9 * peri_stable_step(p.body));
            r = swing(p.body, duration / 40, 40, 0.8, 1e-8);
            CHECK((double)r.passes <= passes / 20);
        } else {
            const peri_solve_desc s = statics_of(1e-10);
            (void)solve(p.body, &s);
        }
        u[k] = get(p.body, PERI_FIELD_DISPLACEMENT);
        close_bar(&p);
    }
    CHECK(furthest(u[0], u[1], n) <= 0.03 * furthest(u[1], u[1] + 1, n - 1));
    free(u[0]);
    free(u[1]);
}

/* A bar that is pulled until it breaks: bonds over their limit are broken at each whole step, and energy is accounted for. */
static void bonds_break(void) {
    const double from[2] = {8 * H, -H}, to[2] = {8 * H, 2.25 * H};
    static const int32_t geometry[2] = {PERI_GEOMETRY_LINEAR, PERI_GEOMETRY_NONLINEAR};
    int k;
    for (k = 0; k < 2; ++k) {
        bar p;
        double step, pull[2] = {0, 0};
        peri_energy e;
        peri_solve_report r, none;
        peri_solve_desc s = statics_of(1e-9);
        peri_advance_desc advance;
        bar_of(&p, geometry[k], 16, 6, 0.02);
        (void)MUST(p.body, peri_cut_segment(p.body, PERI_CUT_INITIAL, from, to));
        step = 20 * peri_stable_step(p.body);
        pull[0] = 0.04 * 16 * H / (60 * step);
        (void)MUST(p.body, peri_prescribe_velocity(p.body, slab(p.body, 0, 14 * H, 16 * H), PERI_AXIS_X, pull, NULL, NULL));
        r = swing(p.body, step, 60, 1, 1e-9);
        e = energy_of(p.body);
        CHECK(r.broken > 10 && 2 * r.broken == 2 * peri_broken_count(p.body));
        CHECK(e.fracture > 0 && fabs(e.error) <= (k ? 0.02 : 1e-6) * e.external);
        (void)MUST(p.body, peri_reset(p.body));
        s.fracture = 0;
        advance = steps_of(step, 60);
        (void)MUST(p.body, peri_advance_implicit(p.body, &advance, &s, 1, &none));
        CHECK(none.broken == 0 && peri_broken_count(p.body) == 0);
        close_bar(&p);
    }
}

/* on_frame, stops, failing steps and what is refused. */
typedef struct watcher {
    int64_t frames, iterations, stop_at;
} watcher;
static int32_t count_frame(void *user, peri_body *b) {
    watcher *w = (watcher *)user;
    (void)b;
    return ++w->frames == w->stop_at;
}
static int32_t stop_there(void *user, int64_t iteration, double residual) {
    watcher *w = (watcher *)user;
    (void)residual;
    w->iterations = iteration;
    return w->stop_at > 0 && iteration >= w->stop_at;
}
static int32_t put_wall(void *user, peri_body *b) {
    return peri_add_obstacle(b, (const peri_obstacle_desc *)user) < 0 ? -1 : 0;
}

static double latest_break(peri_body *b) {
    peri_cracks_desc d;
    peri_cracks *c = NULL;
    double time[256], latest = 0;
    peri_cracks_desc_init(&d), d.shortest = 0;
    (void)MUST(b, peri_cracks_create(b, &d, &c));
    CHECK(peri_cracks_vertices(c) > 1 && peri_cracks_vertices(c) < 256);
    if (peri_cracks_vertices(c) < 256) (void)MUST(b, peri_get_cracks(c, NULL, NULL, time, NULL));
    for (int64_t k = 0; k < peri_cracks_vertices(c); ++k) latest = time[k] > latest ? time[k] : latest;
    peri_cracks_destroy(c);
    return latest;
}

/* A step that fails after bonds broke takes their energy as fracture: the first law goes on. What a frame adds is refused as at first, and
   so are criteria that go by how long and how fast. */
static void failures_are_paid_for(void) {
    const double from[2] = {8 * H, -H}, to[2] = {8 * H, 2.25 * H};
    static const int32_t timed[2] = {PERI_CRITERION_RATE_STRETCH, PERI_CRITERION_DELAYED_STRETCH};
    int k;
    bar p;
    double step, pull[2] = {0, 0};
    peri_energy e;
    peri_solve_desc s = statics_of(1e-9);
    peri_advance_desc r;
    peri_obstacle_desc o;
    bar_of(&p, PERI_GEOMETRY_LINEAR, 16, 6, 0.02);
    (void)MUST(p.body, peri_cut_segment(p.body, PERI_CUT_INITIAL, from, to));
    step = 20 * peri_stable_step(p.body);
    pull[0] = 0.04 * 16 * H / (60 * step);
    (void)MUST(p.body, peri_prescribe_velocity(p.body, slab(p.body, 0, 14 * H, 16 * H), PERI_AXIS_X, pull, NULL, NULL));
    s.breaks = 3;
    r = steps_of(step, 60);
    (void)MUST(p.body, peri_record_breaks(p.body, 1));
    CHECK(peri_advance_implicit(p.body, &r, &s, 1, NULL) == PERI_ERROR_CONVERGENCE && peri_broken_count(p.body) > 0);
    CHECK(latest_break(p.body) == peri_time(p.body)); /* and broke when the body was last whole: the step that failed never was */
    e = energy_of(p.body);
    CHECK(e.fracture > 0 && fabs(e.error) <= 1e-6 * e.external);
    peri_obstacle_desc_init(&o, PERI_SHAPE_BALL);
    o.place[0] = -9 * H;
    o.radius = H;
    o.stiffness = YOUNG / H / H;
    s.breaks = 1000;
    r = steps_of(step, 6);
    r.frame_steps = 2;
    r.on_frame = put_wall;
    r.user = &o;
    CHECK(peri_advance_implicit(p.body, &r, &s, 1, NULL) == PERI_ERROR_LAW);
    close_bar(&p);
    for (k = 0; k < 2; ++k) {
        specimen t = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0.25, H, 2.2, 6, 3, 1);
        t.material.criterion = timed[k];
        t.material.critical_stretch = 0.02;
        if (k == 0) t.material.rate = 1;
        else t.material.delay = 1;
        peri_body *b = specimen_make(&t);
        r = steps_of(peri_stable_step(b), 1);
        CHECK(peri_advance_implicit(b, &r, NULL, 1, NULL) == PERI_ERROR_LAW);
        s = statics_of(0);
        s.fracture = 0;
        (void)MUST(b, peri_advance_implicit(b, &r, &s, 1, NULL));
        peri_body_destroy(b);
    }
}

static void frames_stops_and_refusals(void) {
    bar p;
    double step, *u, *w;
    watcher seen = {0, 0, 0};
    peri_advance_desc r;
    peri_solve_desc s = statics_of(1e-10);
    peri_obstacle_desc o;
    int32_t wall;
    bar_of(&p, PERI_GEOMETRY_LINEAR, 12, 4, 0);
    find_mode(&p);
    put(p.body, PERI_FIELD_DISPLACEMENT, p.mode);
    step = 10 * peri_stable_step(p.body);
    r = steps_of(step, 12);
    r.frame_steps = 3;
    r.on_frame = count_frame;
    r.user = &seen;
    (void)MUST(p.body, peri_advance_implicit(p.body, &r, &s, 1, NULL));
    CHECK(seen.frames == 4 && peri_step_count(p.body) == 12);
    seen.stop_at = 6;
    CHECK(peri_advance_implicit(p.body, &r, &s, 1, NULL) == PERI_STOPPED && peri_step_count(p.body) == 18);
    u = get(p.body, PERI_FIELD_DISPLACEMENT);
    seen.stop_at = 1;
    s.on_iteration = stop_there;
    s.user = &seen;
    CHECK(peri_advance_implicit(p.body, &r, &s, 1, NULL) == PERI_STOPPED);
    s.on_iteration = NULL;
    s.iterations = 1;
    s.tolerance = 1e-13;
    CHECK(peri_advance_implicit(p.body, &r, &s, 1, NULL) == PERI_ERROR_CONVERGENCE);
    w = get(p.body, PERI_FIELD_DISPLACEMENT);
    CHECK(peri_step_count(p.body) == 18 && memcmp(u, w, (size_t)p.n * sizeof *u) == 0); /* as it was at the last whole step */
    free(u);
    free(w);
    CHECK(peri_advance_implicit(p.body, NULL, NULL, 1, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_advance_implicit(p.body, &r, NULL, 1.5, NULL) == PERI_ERROR_RANGE);
    CHECK(peri_advance_implicit(p.body, &r, NULL, NAN, NULL) == PERI_ERROR_RANGE);
    r.time_step = 0;
    CHECK(peri_advance_implicit(p.body, &r, NULL, 1, NULL) == PERI_ERROR_RANGE);
    r.time_step = step;
    s = statics_of(0);
    s.method = PERI_METHOD_RELAXATION;
    CHECK(peri_advance_implicit(p.body, &r, &s, 1, NULL) == PERI_ERROR_LAW);
    s = statics_of(0);
    s.control = PERI_CONTROL_FRACTURE;
    CHECK(peri_advance_implicit(p.body, &r, &s, 1, NULL) == PERI_ERROR_LAW);
    peri_obstacle_desc_init(&o, PERI_SHAPE_BALL);
    o.place[0] = -9 * H;
    o.radius = H;
    o.stiffness = YOUNG / H / H;
    wall = (int32_t)MUST(p.body, peri_add_obstacle(p.body, &o));
    CHECK(peri_advance_implicit(p.body, &r, NULL, 1, NULL) == PERI_ERROR_LAW);
    (void)MUST(p.body, peri_remove_obstacle(p.body, wall));
    r.on_frame = NULL;
    (void)MUST(p.body, peri_advance_implicit(p.body, &r, NULL, 1, NULL));
    close_bar(&p);
}

/* Free of any support, in double and in the other precisions: a translation stays one. */
static void a_free_body_flies_on(void) {
    static const int32_t precision[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE};
    const double v[3] = {1e-3, 2e-3, -1e-3};
    int k;
    for (k = 0; k < 3; ++k) {
        solid s = solid_of(PERI_SPACE_SOLID, PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE);
        peri_body *b;
        double linear[3], after[3], *u;
        s.precision = precision[k];
        s.ratio = 2;
        b = solid_block(&s, 5, 4, 4);
        (void)MUST(b, peri_add_velocity(b, PERI_ALL, v));
        (void)MUST(b, peri_get_momentum(b, linear, NULL));
        (void)swing(b, 50 * peri_stable_step(b), 8, 0.7, 0);
        (void)MUST(b, peri_get_momentum(b, after, NULL));
        u = get(b, PERI_FIELD_DISPLACEMENT);
        CHECK_NEAR(u[0], v[0] * peri_time(b), k ? 1e-4 : 1e-8, 0);
        CHECK_NEAR(after[1], linear[1], k ? 1e-4 : 1e-8, 0);
        free(u);
        peri_body_destroy(b);
    }
}

/* Whatever allocation fails, the body stays as it was and the next call goes on. */
static void memory_may_fail(void) {
    pool memory;
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
    specimen q = solid_specimen(&s, 24, 12, 1);
    const double v[2] = {1e-3, 0};
    peri_body *b;
    peri_advance_desc r;
    int64_t k, refused = 0, held;
    memset(&memory, 0, sizeof memory);
    memory.fail_at = -1;
    hook(&q.desc, &memory);
    b = specimen_make(&q);
    (void)MUST(b, peri_add_velocity(b, slab(b, 0, 0, 12 * H), v));
    r = steps_of(10 * peri_stable_step(b), 1);
    held = memory.bytes;
    for (k = 0; k < 60; ++k) {
        int32_t status;
        memory.fail_at = memory.calls + k;
        status = peri_advance_implicit(b, &r, NULL, 1, NULL);
        memory.fail_at = -1;
        CHECK(status == PERI_OK || status == PERI_ERROR_MEMORY);
        CHECK(memory.bytes == held && peri_step_count(b) == k + 1 - (refused += status < 0));
        if (status == PERI_OK) break;
    }
    CHECK(refused > 10);
    peri_body_destroy(b);
    CHECK(memory.blocks == 0 && memory.wrong == 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(order_is_two);
    RUN(calls_go_on);
    RUN(stable_and_conserving);
    RUN(ledger_closes);
    RUN(order_holds_in_large_motion);
    RUN(slow_loads_cost_little);
    RUN(bonds_break);
    RUN(failures_are_paid_for);
    RUN(frames_stops_and_refusals);
    RUN(a_free_body_flies_on);
    RUN(memory_may_fail);
    return test_end("test_implicit");
}
