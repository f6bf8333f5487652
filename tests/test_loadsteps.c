/* SPDX-License-Identifier: MIT */
/* test_loadsteps.c - what a solve asks callbacks for, tells, records, refuses and leaves behind.

   SOURCE OF TRUTH: peri.h, field by field; the linear problem, whose answer is proportional to the load factor; a second body on which
   the same is done another way. */
#include "solid.h"
#include "equilibrium.h"

/* ---- a plate that is held, pulled by a constant load and moved by a callback -------------------------------------- */

typedef struct plate {
    peri_body *body;
    int32_t    grip, roller, pull, wind;
    double     asked[64]; /* times at which the callback was asked, each once */
    int64_t    count;
    int64_t    poison;    /* the call from which on it writes NaN; 0: never */
    int64_t    calls;
} plate;

static void note(plate *p, double time) {
    if (p->count < 64 && (p->count == 0 || p->asked[p->count - 1] != time)) p->asked[p->count++] = time;
}
static int32_t shear(void *user, double time, int64_t count, const int32_t *points, double *value) {
    plate *p = (plate *)user;
    int64_t k;
    note(p, time);
    for (k = 0; k < count; ++k) {
        CHECK(value[2 * k] == 0.5 && value[2 * k + 1] == 7 && points[k] >= 0); /* the constant value at entry */
        value[2 * k] = 0;
        value[2 * k + 1] = 2e-3 * time;
    }
    if (p->poison && ++p->calls >= p->poison) value[2 * count - 1] = NAN;
    return 0;
}

static plate plate_of(int32_t geometry, int32_t precision) {
    const double up[2] = {0, 1e-3 * H}, right[2] = {4e-3, 0};
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
    plate p;
    memset(&p, 0, sizeof p);
    s.ratio = 2;
    s.geometry = geometry;
    s.precision = precision;
    p.body = solid_block(&s, 14, 8, 1);
    p.grip = (int32_t)MUST(p.body, peri_prescribe_displacement(p.body, slab(p.body, 0, 0, 3 * H), PERI_AXIS_XY, NULL, NULL, NULL));
    p.roller = (int32_t)MUST(p.body, peri_prescribe_displacement(p.body, slab(p.body, 0, 12 * H, 14 * H), PERI_AXIS_Y, up, NULL, NULL));
    p.pull = (int32_t)MUST(p.body, peri_apply_layer_traction(p.body, slab(p.body, 0, 13 * H, 14 * H), 8 * H, right, NULL, NULL));
    return p;
}
static void blow_on(plate *p) { /* p stays where it is from now on */
    const double first[2] = {0.5, 7};
    p->wind = (int32_t)MUST(p->body, peri_apply_body_force(p->body, slab(p->body, 1, 4 * H, 8 * H), first, shear, p));
}
static int64_t dofs(const plate *p) { return 2 * peri_point_count(p->body); }

/* ---- load factors, curve and callbacks ---------------------------------------------------------------------------- */

typedef struct witness {
    plate  *p;
    double  factor[32], moved[32], force[32][2], wind[32][2]; /* as read in on_step */
    int64_t count, stop_at, steps[32];
} witness;
static int32_t watch(void *user, peri_body *b) {
    witness *w = (witness *)user;
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    int64_t i;
    w->factor[w->count] = w->p->asked[w->p->count - 1];
    w->steps[w->count] = peri_step_count(b);
    for (i = 0; i < peri_point_count(b); ++i)
        if (i % 14 >= 12) w->moved[w->count] += u[2 * i + 1] / 16;
    (void)MUST(b, peri_get_reaction(b, w->p->roller, w->force[w->count]));
    (void)MUST(b, peri_get_reaction(b, w->p->wind, w->wind[w->count]));
    free(u);
    w->count++;
    return w->count == w->stop_at;
}

/* Constant values times the factor, callbacks at time = factor (once or more at each), rows as what is read at each step; the linear
   problem is proportional to the factor. Rows beyond those that fit are counted, and not written. */
static void factors_rows_and_units(void) {
    static const double ends[3][2] = {{0, 1}, {0.5, 2}, {1, -0.5}};
    int32_t precision;
    int k, i;
    for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; precision += 2)
        for (k = 0; k < 3; ++k) {
            double rows[6][6], tolerance = precision == PERI_PRECISION_DOUBLE ? 1e-7 : 3e-3;
            const double area = 14 * 4 * H * H * THICK;
            plate p = plate_of(PERI_GEOMETRY_LINEAR, precision);
            witness w;
            peri_solve_desc st;
            peri_solve_report r;
            double per[2] = {0, 0};
            peri_solve_desc_init(&st);
            if (precision == PERI_PRECISION_DOUBLE) st.tolerance = 1e-10;
            else st.tolerance = 2e-5;
            memset(&w, 0, sizeof w);
            w.p = &p;
            blow_on(&p);
            st.load_from = ends[k][0];
            st.load_to = ends[k][1];
            st.steps = 5;
            st.curve_load = p.roller;
            st.curve = rows[0];
            st.curve_rows = 3;
            st.on_step = watch;
            st.user = &w;
            for (i = 0; i < 36; ++i) rows[i / 6][i % 6] = -77;
            r = solve(p.body, &st);
            CHECK(r.steps == 5 && r.curve_rows == 5 && w.count == 5 && r.load_factor == ends[k][1] && peri_step_count(p.body) == 5);
            CHECK(peri_time(p.body) == 0);
            for (i = 0; i < 5; ++i) {
                double f = ends[k][0] + (ends[k][1] - ends[k][0]) * (i + 1) / 5;
                CHECK_NEAR(w.factor[i], f, 1e-15, 1e-16);
                CHECK(w.steps[i] == i + 1);
                CHECK_NEAR(w.moved[i], f * 1e-3 * H, precision == PERI_PRECISION_DOUBLE ? 1e-14 : 1e-6, 0);
                CHECK_NEAR(w.wind[i][1], f * 2e-3 * area, precision == PERI_PRECISION_DOUBLE ? 1e-12 : 1e-6, 0);
                if (i == 0) memcpy(per, w.force[0], sizeof per);
                CHECK_NEAR(w.force[i][1] / f, per[1] / w.factor[0], tolerance, 0);
                CHECK(w.force[i][0] == 0);
                if (i >= 3) continue;
                CHECK_NEAR(rows[i][0], f, 1e-15, 1e-16);
                CHECK_NEAR(rows[i][2], f * 1e-3 * H, precision == PERI_PRECISION_DOUBLE ? 1e-14 : 1e-6, 0);
                CHECK(rows[i][1] != 0 && rows[i][3] == w.force[i][0] && rows[i][4] == w.force[i][1] && rows[i][5] == 0);
            }
            for (i = 18; i < 36; ++i) CHECK(rows[i / 6][i % 6] == -77);
            for (i = 0; i < p.count; ++i) { /* nothing but the planned factors, in order, the start perhaps first */
                double f = ends[k][0] + (ends[k][1] - ends[k][0]) * (i + 6 - (int)p.count) / 5;
                CHECK_NEAR(p.asked[i], f, 1e-15, 1e-16);
            }
            peri_body_destroy(p.body);
        }
}

/* The force of a load, in a row, is what it is on the body: the present total. */
static void rows_of_a_load(void) {
    double row[6];
    plate p = plate_of(PERI_GEOMETRY_NONLINEAR, PERI_PRECISION_DOUBLE);
    peri_solve_desc st = statics_of(1e-9);
    st.load_to = 0.25;
    st.curve_load = p.pull;
    st.curve = row;
    st.curve_rows = 1;
    (void)solve(p.body, &st);
    CHECK(row[0] == 0.25);
    CHECK_NEAR(row[3], 0.25 * 4e-3 * 8 * H * THICK, 1e-13, 0);
    CHECK(row[1] > 0 && row[4] == 0);
    peri_body_destroy(p.body);
}

/* ---- stopping and going on ---------------------------------------------------------------------------------------- */

static int32_t stop_after(void *user, int64_t iteration, double residual) {
    CHECK(iteration >= 1 && residual >= 0 && isfinite(residual));
    return --*(int64_t *)user == 0;
}

/* Stopped in a callback of the linear solver, by want of iterations, or between steps, and called again until done: the same answer as in
   one go, to the tolerance. */
static void a_solve_that_was_stopped_goes_on(void) {
    int32_t geometry;
    int how;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry) {
        double *whole = NULL;
        for (how = 0; how < 6; ++how) {
            plate p = plate_of(geometry, PERI_PRECISION_DOUBLE);
            peri_solve_desc st = statics_of(1e-9);
            peri_solve_report r;
            witness w;
            int64_t left = 7, calls = 0;
            double *u;
            int32_t code = PERI_OK;
            peri_error e;
            memset(&w, 0, sizeof w);
            w.p = &p;
            blow_on(&p);
            if (how == 1 || how > 3) {
                st.on_iteration = stop_after;
                st.user = &left;
                st.method = how == 4 ? PERI_METHOD_BICGSTAB : how == 5 ? PERI_METHOD_RELAXATION : PERI_METHOD_NEWTON;
            }
            if (how == 2) st.iterations = 10;
            if (how == 2) st.halvings = 0; /* else a nonlinear step is halved until they suffice */
            if (how == 3) {
                st.on_step = watch;
                st.user = &w;
                st.steps = 4;
                w.stop_at = 2;
            }
            do {
                code = peri_solve(p.body, &st, &r);
                if (how == 1 || how > 3) {
                    CHECK(code != PERI_STOPPED || left == 0);
                    left = how == 5 ? 300 : 7 + 3 * calls;
                }
                if (how == 2 && code == PERI_ERROR_CONVERGENCE) {
                    CHECK(peri_get_error(p.body, &e) == PERI_OK && e.value == r.residual && e.value > 1e-9 && r.iterations == 10);
                    CHECK(r.load_factor == 0 && r.steps == 0);
                }
                if (how == 3 && code == PERI_STOPPED) {
                    CHECK(r.steps == 2 && r.load_factor == 0.5);
                    st.load_from = r.load_factor;
                    st.steps = 2;
                }
                calls++;
            } while ((code == PERI_STOPPED || (how == 2 && code == PERI_ERROR_CONVERGENCE)) && calls < 60);
            CHECK(MUST(p.body, code) == PERI_OK && (calls > 1) == (how > 0) && r.load_factor == 1);
            u = get(p.body, PERI_FIELD_DISPLACEMENT);
            if (how == 0) whole = u;
            else CHECK(furthest(u, whole, dofs(&p)) <= 1e-6 * largest(whole, dofs(&p)));
            if (how) free(u);
            peri_body_destroy(p.body);
        }
        free(whole);
    }
}

static int32_t meddle_in_iteration(void *user, int64_t iteration, double residual) {
    plate *p = (plate *)user;
    const double v[2] = {1, 1}, from[2] = {0, 0}, to[2] = {1, 1};
    peri_advance_desc run;
    peri_solve_desc st;
    double *u = get(p->body, PERI_FIELD_DISPLACEMENT);
    (void)residual;
    peri_advance_desc_init(&run);
    run.steps = 1;
    peri_solve_desc_init(&st);
    if (iteration == 2) {
        CHECK(peri_add_displacement(p->body, PERI_ALL, v) == PERI_ERROR_ORDER);
        CHECK(peri_set_field(p->body, PERI_FIELD_DISPLACEMENT, u, dofs(p)) == PERI_ERROR_ORDER);
        CHECK(peri_cut_segment(p->body, PERI_CUT_NOW, from, to) == PERI_ERROR_ORDER);
        CHECK(peri_remove_load(p->body, p->pull) == PERI_ERROR_ORDER);
        CHECK(peri_apply_body_force(p->body, PERI_ALL, v, NULL, NULL) == PERI_ERROR_ORDER);
        CHECK(peri_advance(p->body, &run) == PERI_ERROR_ORDER && peri_solve(p->body, &st, NULL) == PERI_ERROR_ORDER);
        CHECK(peri_reset(p->body) == PERI_ERROR_ORDER && peri_multiply_stiffness(p->body, u, u, dofs(p)) == PERI_ERROR_ORDER);
    }
    free(u);
    return 0;
}
static int32_t change_in_step(void *user, peri_body *b) { /* as on_frame: loads, cuts */
    plate *p = (plate *)user;
    const double from[2] = {7 * H, 5 * H}, to[2] = {7 * H, 9 * H};
    peri_solve_desc st;
    peri_solve_desc_init(&st);
    if (p->count++ == 0) {
        CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_NOW, from, to)) > 10);
        CHECK(MUST(b, peri_remove_load(b, p->pull)) == PERI_OK);
        CHECK(peri_solve(b, &st, NULL) == PERI_ERROR_ORDER && peri_reset(b) == PERI_ERROR_ORDER);
    }
    return 0;
}
static void callbacks_may_and_may_not(void) {
    plate p = plate_of(PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE), q = plate_of(PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE);
    plate c = plate_of(PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE);
    const double from[2] = {7 * H, 5 * H}, to[2] = {7 * H, 9 * H};
    peri_solve_desc st = statics_of(1e-10), calm = statics_of(1e-10);
    double *u, *w;
    st.on_iteration = meddle_in_iteration;
    st.user = &p;
    (void)solve(p.body, &st);
    (void)solve(q.body, &calm);
    u = get(p.body, PERI_FIELD_DISPLACEMENT);
    w = get(q.body, PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(u, w, (size_t)dofs(&p) * sizeof *u) == 0);
    free(u);
    free(w);
    /* changed at the first of two steps: the second is as if it had been so from the start, for a linear body */
    st = calm;
    st.steps = 2;
    st.on_step = change_in_step;
    st.user = &c;
    (void)solve(c.body, &st);
    CHECK(peri_reset(q.body) == PERI_OK && MUST(q.body, peri_cut_segment(q.body, PERI_CUT_INITIAL, from, to)) > 10);
    (void)MUST(q.body, peri_remove_load(q.body, q.pull));
    (void)solve(q.body, &calm);
    u = get(c.body, PERI_FIELD_DISPLACEMENT);
    w = get(q.body, PERI_FIELD_DISPLACEMENT);
    CHECK(furthest(u, w, dofs(&q)) <= 1e-8 * largest(w, dofs(&q)));
    CHECK(peri_broken_count(c.body) > 10 && peri_cut_count(c.body) == 0);
    free(u);
    free(w);
    peri_body_destroy(p.body);
    peri_body_destroy(q.body);
    peri_body_destroy(c.body);
}

/* ---- what it leaves ----------------------------------------------------------------------------------------------- */

/* From equilibrium, with the same loads, the motion stays at rest: the residual, 1e-11 of the loads, moves it by less than 1e-8 of the
   displacements. The state before had velocities: they are gone, and the ledger has them as damped. */
static void at_rest_afterwards(void) {
    int32_t geometry;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry) {
        plate p = plate_of(geometry, PERI_PRECISION_DOUBLE);
        const double fast[2] = {1e-3, 2e-3};
        peri_solve_desc st = statics_of(1e-11);
        peri_energy e;
        peri_advance_desc run;
        double *u, *w, *v, kinetic;
        blow_on(&p);
        (void)MUST(p.body, peri_add_velocity(p.body, PERI_ALL, fast));
        (void)MUST(p.body, peri_get_energy(p.body, &e));
        kinetic = e.kinetic;
        (void)solve(p.body, &st);
        v = get(p.body, PERI_FIELD_VELOCITY);
        CHECK(largest(v, dofs(&p)) == 0);
        free(v);
        (void)MUST(p.body, peri_get_energy(p.body, &e));
        CHECK(e.kinetic == 0 && kinetic > 0);
        CHECK_NEAR(e.initial, kinetic, 1e-12, 0);
        CHECK_NEAR(e.damping, kinetic, 1e-12, 0);
        if (geometry == PERI_GEOMETRY_LINEAR) CHECK_NEAR(e.external, e.elastic, 1e-8, 0);
        u = get(p.body, PERI_FIELD_DISPLACEMENT);
        /* the callback is asked for time in a run: at rest where it would be asked for the factor 1 */
        (void)MUST(p.body, peri_remove_load(p.body, p.wind));
        (void)solve(p.body, &st);
        free(u);
        u = get(p.body, PERI_FIELD_DISPLACEMENT);
        peri_advance_desc_init(&run);
        run.steps = 200;
        (void)MUST(p.body, peri_advance(p.body, &run));
        w = get(p.body, PERI_FIELD_DISPLACEMENT);
        CHECK(furthest(u, w, dofs(&p)) <= 1e-8 * largest(u, dofs(&p)));
        free(u);
        free(w);
        peri_body_destroy(p.body);
    }
}

/* Loads stay at their last factor, for what reads them, where forces are in balance, and for a run, unless that is given another. */
static void loads_stay_at_the_last_factor(void) {
    plate p = plate_of(PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE);
    peri_solve_desc st = statics_of(1e-10);
    peri_advance_desc run;
    double force[2];
    st.load_to = 0.4;
    (void)solve(p.body, &st);
    (void)MUST(p.body, peri_get_reaction(p.body, p.pull, force));
    CHECK_NEAR(force[0], 0.4 * 4e-3 * 8 * H * THICK, 1e-12, 0);
    for (int k = 0; k < 2; ++k) {
        double *f = get(p.body, PERI_FIELD_FORCE_DENSITY);
        CHECK(largest(f, dofs(&p)) < 1e-9); /* loads of 4e-3/H */
        free(f);
        (void)MUST(p.body, peri_add_velocity(p.body, PERI_ALL, (const double[2]){0, 0})); /* forces are made anew */
    }
    peri_advance_desc_init(&run);
    run.steps = 1;
    for (int k = 0; k < 3; ++k) { /* where the body stands, in full, and there again */
        run.load_factor = k == 1 ? 1 : (double)NAN;
        CHECK(peri_load_factor(p.body) == (k < 2 ? 0.4 : 1));
        CHECK(peri_advance(p.body, &run) == PERI_OK && peri_get_reaction(p.body, p.pull, force) == PERI_OK);
        CHECK_NEAR(force[0], (k < 1 ? 0.4 : 1) * 4e-3 * 8 * H * THICK, 1e-12, 0);
    }
    peri_body_destroy(p.body);
}

/* The same bits after a reset, and from a clone made before or half way. */
static void reset_and_clone(void) {
    plate p = plate_of(PERI_GEOMETRY_NONLINEAR, PERI_PRECISION_DOUBLE);
    peri_solve_desc st = statics_of(1e-9);
    peri_body *before = NULL, *half = NULL;
    double *u, *w, *zero;
    size_t bytes = (size_t)dofs(&p) * sizeof *u;
    (void)MUST(p.body, peri_body_clone(p.body, &before, NULL));
    st.steps = 2;
    st.load_to = 0.5; /* from 0, and on from where body and clone stand: below, the same said in numbers */
    (void)solve(p.body, &st);
    (void)MUST(p.body, peri_body_clone(p.body, &half, NULL));
    st.load_to = 1;
    (void)solve(p.body, &st);
    u = get(p.body, PERI_FIELD_DISPLACEMENT);
    (void)solve(half, &st);
    w = get(half, PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(u, w, bytes) == 0);
    free(w);
    (void)MUST(p.body, peri_reset(p.body));
    zero = get(p.body, PERI_FIELD_DISPLACEMENT);
    CHECK(largest(zero, dofs(&p)) == 0 && peri_step_count(p.body) == 0);
    free(zero);
    st.load_from = 0;
    st.load_to = 0.5;
    (void)solve(p.body, &st);
    (void)solve(before, &st);
    st.load_from = 0.5;
    st.load_to = 1;
    (void)solve(p.body, &st);
    (void)solve(before, &st);
    w = get(p.body, PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(u, w, bytes) == 0);
    free(w);
    w = get(before, PERI_FIELD_DISPLACEMENT);
    CHECK(memcmp(u, w, bytes) == 0);
    free(w);
    free(u);
    peri_body_destroy(before);
    peri_body_destroy(half);
    peri_body_destroy(p.body);
}

static void no_load_and_nothing_free(void) {
    int32_t method, geometry;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
        for (method = PERI_METHOD_NEWTON; method < peri__end_method; ++method) {
            const double moved[2] = {0.01, -0.02};
            solid s = solid_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_OTERKUS, PERI_CORRECTION_NONE);
            peri_solve_desc st = statics_of(0);
            peri_solve_report r;
            peri_body *b;
            double *u, *f;
            s.geometry = geometry;
            b = solid_block(&s, 8, 6, 1);
            st.method = method;
            (void)MUST(b, peri_prescribe_displacement(b, slab(b, 0, 0, 3 * H), PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
            r = solve(b, &st);
            u = get(b, PERI_FIELD_DISPLACEMENT);
            CHECK(largest(u, 96) == 0 && r.iterations == 0 && r.residual == 0 && r.steps == 1);
            free(u);
            (void)MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_X | PERI_AXIS_Y, moved, NULL, NULL)); /* all is given */
            r = solve(b, &st);
            u = get(b, PERI_FIELD_DISPLACEMENT);
            f = get(b, PERI_FIELD_REACTION);
            CHECK(fabs(u[0] - 0.01) < 1e-15 && fabs(u[95] + 0.02) < 1e-15 && largest(f, 96) < 1e-10 && r.residual <= 1e-8);
            free(u);
            free(f);
            peri_body_destroy(b);
        }
}

/* ---- refusals ----------------------------------------------------------------------------------------------------- */

enum { I32, I64, F64, CURVE, COOKIE };
static void bad_fields_are_named(void) {
    static const struct bad {
        const char *name;
        size_t      at;
        int         kind;
        double      value;
        int32_t     code;
    } bads[] = {
#define BAD(field, kind, value, code) {#field, offsetof(peri_solve_desc, field), kind, value, code}
        BAD(method, I32, 0, PERI_ERROR_CHOICE),             BAD(method, I32, 4, PERI_ERROR_CHOICE),
        BAD(preconditioner, I32, 0, PERI_ERROR_CHOICE),     BAD(preconditioner, I32, 4, PERI_ERROR_CHOICE),
        BAD(loose, I32, 0, PERI_ERROR_CHOICE),              BAD(loose, I32, 4, PERI_ERROR_CHOICE),
        BAD(fracture, I32, 2, PERI_ERROR_CHOICE),           BAD(fracture, I32, -1, PERI_ERROR_CHOICE),
        BAD(criticality, F64, -0.1, PERI_ERROR_RANGE),      BAD(criticality, F64, 1.1, PERI_ERROR_RANGE),
        BAD(criticality, F64, NAN, PERI_ERROR_RANGE),       BAD(tolerance, F64, -1e-9, PERI_ERROR_RANGE),
        BAD(tolerance, F64, 1, PERI_ERROR_RANGE),           BAD(tolerance, F64, NAN, PERI_ERROR_RANGE),
        BAD(energy_tolerance, F64, -1, PERI_ERROR_RANGE),   BAD(energy_tolerance, F64, NAN, PERI_ERROR_RANGE),
        BAD(iterations, I64, 0, PERI_ERROR_ARGUMENT),       BAD(iterations, I64, -5, PERI_ERROR_ARGUMENT),
        BAD(newton, I64, 0, PERI_ERROR_ARGUMENT),           BAD(breaks, I64, -1, PERI_ERROR_ARGUMENT),
        BAD(load_from, F64, INFINITY, PERI_ERROR_RANGE),    BAD(load_to, F64, NAN, PERI_ERROR_RANGE),
        BAD(steps, I64, 0, PERI_ERROR_ARGUMENT),            BAD(halvings, I64, -1, PERI_ERROR_ARGUMENT),
        BAD(halvings, I64, 61, PERI_ERROR_ARGUMENT),        BAD(curve_load, I32, 99, PERI_ERROR_ID_NONE),
        BAD(curve_load, I32, -2, PERI_ERROR_ID_NONE),       BAD(curve_rows, I64, -1, PERI_ERROR_ARGUMENT),
        BAD(curve, CURVE, 0, PERI_ERROR_ARGUMENT),          BAD(cookie, COOKIE, 0, PERI_ERROR_DESCRIPTOR)};
    plate p = plate_of(PERI_GEOMETRY_LINEAR, PERI_PRECISION_DOUBLE);
    peri_solve_desc st;
    peri_solve_report r;
    peri_error e;
    size_t k;
    double *u;
    for (k = 0; k < sizeof bads / sizeof bads[0]; ++k) {
        const char *want = bads[k].kind == COOKIE ? "desc" : strcmp(bads[k].name, "curve_rows") ? bads[k].name : "curve";
        int32_t code;
        peri_solve_desc_init(&st);
        if (bads[k].kind == I32) *(int32_t *)((char *)&st + bads[k].at) = (int32_t)bads[k].value;
        if (bads[k].kind == I64) *(int64_t *)((char *)&st + bads[k].at) = (int64_t)bads[k].value;
        if (bads[k].kind == F64) *(double *)((char *)&st + bads[k].at) = bads[k].value;
        if (bads[k].kind == CURVE) {
            st.curve_load = p.grip;
            st.curve_rows = 3; /* and no curve */
        }
        if (bads[k].kind == COOKIE) st.cookie++;
        code = peri_solve(p.body, &st, &r);
        (void)peri_get_error(p.body, &e);
        if (code == bads[k].code && e.code == code && strcmp(e.field, want) == 0) continue;
        printf("    %s = %g: %d, field %s\n", bads[k].name, bads[k].value, (int)code, e.field);
        test_bad++;
    }
    u = get(p.body, PERI_FIELD_DISPLACEMENT);
    CHECK(largest(u, dofs(&p)) == 0);
    free(u);
    peri_solve_desc_init(NULL);
    peri_solve_desc_init(&st);
    CHECK(peri_solve(NULL, &st, NULL) < 0 && peri_solve(p.body, NULL, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_multiply_stiffness(p.body, NULL, NULL, 0) == PERI_ERROR_ARGUMENT && peri_matrix_create(p.body, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_matrix_rows(NULL) < 0 && peri_matrix_entries(NULL) < 0 && peri_get_matrix(NULL, NULL, NULL, NULL) < 0);
    CHECK(peri_solve(p.body, &st, NULL) == PERI_OK);
    peri_body_destroy(p.body);
}

/* NaN from a load, a support, an obstacle: PERI_ERROR_CALLBACK, at the start or later; the body stays at the last equilibrium, finite, and
   solves when asked properly. */
static int32_t jump(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)points;
    if (time > 0.6) value[count] = *(const double *)user;
    return 0;
}
static int32_t wander(void *user, double time, double *place, double *turn) {
    if (time > 0.6) place[1] = *(const double *)user;
    return (void)turn, 0;
}
static void nan_from_callbacks(void) {
    int32_t geometry;
    int who;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
        for (who = 0; who < 3; ++who) {
            plate p = plate_of(geometry, PERI_PRECISION_DOUBLE), q = plate_of(geometry, PERI_PRECISION_DOUBLE);
            const double at[2] = {0, -3}, up[2] = {0, 1};
            double bad = NAN, *u, *f, *want;
            peri_solve_desc st = statics_of(1e-10);
            peri_solve_report r;
            peri_error e;
            int32_t id = 0;
            st.steps = 4;
            if (who == 0) id = (int32_t)MUST(p.body, peri_apply_body_force(p.body, slab(p.body, 0, 6 * H, 9 * H), NULL, jump, &bad));
            if (who == 1)
                id = (int32_t)MUST(p.body, peri_prescribe_displacement(p.body, slab(p.body, 0, 0, H), PERI_AXIS_XY, NULL, jump, &bad));
            if (who == 2) id = (int32_t)MUST(p.body, plane_obstacle(p.body, at, up, 0, wander, &bad));
            CHECK(peri_solve(p.body, &st, &r) == PERI_ERROR_CALLBACK);
            CHECK(peri_get_error(p.body, &e) == PERI_OK && e.code == PERI_ERROR_CALLBACK);
            CHECK(r.steps == 2 && r.load_factor == 0.5);
            u = get(p.body, PERI_FIELD_DISPLACEMENT);
            st.steps = 2;
            st.load_to = 0.5;
            (void)solve(q.body, &st); /* without: the callbacks gave 0 up to there */
            want = get(q.body, PERI_FIELD_DISPLACEMENT);
            CHECK(furthest(u, want, dofs(&p)) <= 1e-8 * largest(want, dofs(&p)));
            free(u);
            free(want);
            (void)MUST(p.body, who == 2 ? peri_remove_obstacle(p.body, id) : peri_remove_load(p.body, id));
            f = get(p.body, PERI_FIELD_FORCE_DENSITY); /* of the loads at 0.5 or at what was tried: finite */
            CHECK(isfinite(largest(f, dofs(&p))));
            free(f);
            st.load_to = 1;
            (void)solve(p.body, &st);
            (void)solve(q.body, &st);
            u = get(p.body, PERI_FIELD_DISPLACEMENT);
            want = get(q.body, PERI_FIELD_DISPLACEMENT);
            if (who != 1) CHECK(furthest(u, want, dofs(&p)) <= 1e-8 * largest(want, dofs(&p)));
            free(u);
            free(want);
            peri_body_destroy(p.body);
            peri_body_destroy(q.body);
        }
}

/* Steps that fail leave the body at the last equilibrium, linear or not, with halvings or without: here the first step has nothing to do,
   and the second, when the load sets in, too few iterations. What is read is of that state: u = 0 and the loads at 0.5, none. */
static void a_failed_step_goes_back(void) {
    int32_t geometry;
    int64_t halvings;
    for (geometry = PERI_GEOMETRY_NONLINEAR; geometry < peri__end_geometry; ++geometry)
        for (halvings = 0; halvings <= 2; halvings += 2) {
            solid s = solid_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CORRECTION_NONE);
            peri_body *b;
            peri_solve_desc st = statics_of(1e-9);
            peri_solve_report r;
            double *u, *f, load = 1e-2, force[2], *held;
            int32_t grip, id;
            s.geometry = geometry;
            b = solid_block(&s, 14, 8, 1);
            grip = (int32_t)MUST(b, peri_prescribe_displacement(b, slab(b, 0, 0, 3 * H), PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
            id = (int32_t)MUST(b, peri_apply_body_force(b, slab(b, 0, 6 * H, 9 * H), NULL, jump, &load));
            st.steps = 2;
            st.halvings = halvings;
            st.iterations = 5;
            CHECK(peri_solve(b, &st, &r) == PERI_ERROR_CONVERGENCE && r.steps == 1 && r.load_factor == 0.5);
            u = get(b, PERI_FIELD_DISPLACEMENT);
            f = get(b, PERI_FIELD_FORCE_DENSITY);
            held = get(b, PERI_FIELD_REACTION);
            (void)MUST(b, peri_get_reaction(b, id, force));
            CHECK(largest(u, 224) == 0);
            CHECK(largest(f, 224) == 0 && largest(held, 224) == 0);
            CHECK(force[0] == 0 && force[1] == 0);
            free(u);
            free(f);
            free(held);
            st.iterations = 20000; /* and it solves when allowed */
            r = solve(b, &st);
            (void)MUST(b, peri_get_reaction(b, grip, force));
            CHECK(fabs(force[0]) + fabs(force[1]) > 1e-6);
            peri_body_destroy(b);
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(factors_rows_and_units);
    RUN(rows_of_a_load);
    RUN(a_solve_that_was_stopped_goes_on);
    RUN(callbacks_may_and_may_not);
    RUN(at_rest_afterwards);
    RUN(loads_stay_at_the_last_factor);
    RUN(reset_and_clone);
    RUN(no_load_and_nothing_free);
    RUN(bad_fields_are_named);
    RUN(nan_from_callbacks);
    RUN(a_failed_step_goes_back);
    return test_end("test_loadsteps");
}
