/* SPDX-License-Identifier: MIT */
/* callbacks.c - callbacks that read and change all there is, that stop at once, that write NaN, infinity, nothing, or numbers at the ends
   of the range, and files that fail at each of their pieces. */
#include "scenes.h"

/* ---- callbacks that meddle ---------------------------------------------------------------------------------------- */

typedef struct meddler {
    peri_body *body;
    int64_t    calls, wrong; /* wrong: calls that were not refused as they should have been                              */
    int        quiet;        /* 1: does nothing                                                                          */
    int        frame;        /* 1: called between steps, where sets, loads and cracks may change                         */
} meddler;

static int32_t take_all(void *user, int64_t index, const double *x) {
    (void)user, (void)index, (void)x;
    return 1;
}
static int32_t cut_all(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)i, (void)j, (void)xi, (void)xj;
    return 1;
}

static void read_all(meddler *c) {
    peri_body *b = c->body;
    double v[3], q[3], *x;
    int32_t rows[64];
    uint64_t hash = 0;
    peri_energy e;
    peri_view view;
    peri_memory held;
    peri_error record;
    for (int32_t field = PERI_FIELD_POSITION; field < peri__end_field; ++field) {
        const int64_t n = peri_size_of_field(b, field);
        x = (double *)malloc((size_t)n * sizeof *x);
        c->wrong += peri_get_field(b, field, x, n) != PERI_OK;
        c->wrong += peri_view_field(b, field, &view) != PERI_OK;
        free(x);
    }
    c->wrong += peri_get_energy(b, &e) != PERI_OK || peri_get_momentum(b, v, q) != PERI_OK;
    c->wrong += peri_get_reaction(b, peri_id(b, PERI_KIND_LOAD, 1), v) != PERI_OK || peri_get_memory(b, &held) != PERI_OK;
    c->wrong += peri_get_families(b, 0, 1, rows, 64) != PERI_OK || peri_bond_is_intact(b, 0, rows[0]) < 0;
    c->wrong += !(peri_stable_step(b) > 0) || peri_get_bond_constants(b, material_id(b, 1), material_id(b, 1), NULL, v) != PERI_OK;
    c->wrong += peri_export_history_to(b, 1, scene_swallow, &hash) != PERI_OK || peri_export_vtu_to(b, scene_swallow, &hash) != PERI_OK;
    c->wrong += peri_get_error(b, &record) != PERI_OK;
}

#define NOT_NOW(call) c->wrong += (call) != PERI_ERROR_ORDER

/* What no callback may do. Frames may clone. */
static void change_all(meddler *c) {
    peri_body *b = c->body, *copy = NULL;
    const double v[3] = {1, 2, 3}, far_[3] = {9, 9, 9}, zero[3] = {0, 0, 0}, volume = 1;
    const int64_t n = peri_size_of_field(b, PERI_FIELD_VELOCITY);
    double *x = (double *)calloc((size_t)n, sizeof *x);
    const int32_t ids[2] = {0, 1};
    peri_material_desc m;
    peri_advance_desc run;
    peri_solve_desc s;
    peri_advance_desc_init(&run);
    run.steps = 1;
    peri_solve_desc_init(&s);
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    NOT_NOW(peri_add_material(b, &m));
    NOT_NOW(peri_set_interface(b, material_id(b, 1), material_id(b, 1), &m));
    NOT_NOW(peri_add_box(b, material_id(b, 1), zero, far_, 1));
    NOT_NOW(peri_add_points(b, 1, v, &volume, NULL));
    NOT_NOW(peri_set_families(b, 1, ids));
    NOT_NOW(peri_build(b));
    NOT_NOW(peri_reset(b));
    NOT_NOW(peri_set_field(b, PERI_FIELD_VELOCITY, x, n));
    NOT_NOW(peri_add_displacement(b, PERI_ALL, v));
    NOT_NOW(peri_add_velocity(b, PERI_ALL, v));
    NOT_NOW(peri_advance(b, &run));
    NOT_NOW(peri_solve(b, &s, NULL));
    if (!c->frame) {
        NOT_NOW(peri_select_box(b, "meddled", zero, far_));
        NOT_NOW(peri_select_ball(b, "meddled", zero, 99));
        NOT_NOW(peri_select_if(b, "meddled", take_all, NULL));
        NOT_NOW(peri_select_points(b, "meddled", 2, ids));
        NOT_NOW(peri_cut_pairs(b, PERI_CUT_INITIAL, 1, ids));
        NOT_NOW(peri_cut_if(b, PERI_CUT_INITIAL, cut_all, NULL));
        NOT_NOW(peri_dimension(b) == 2 ? peri_cut_segment(b, PERI_CUT_INITIAL, zero, far_) : peri_cut_disc(b, PERI_CUT_INITIAL, v, v, 9));
        NOT_NOW(peri_set_no_fail(b, PERI_ALL, 1));
        NOT_NOW(peri_on_break(b, NULL, NULL));
        NOT_NOW(peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_X, v, NULL, NULL));
        NOT_NOW(peri_prescribe_velocity(b, PERI_ALL, PERI_AXIS_X, v, NULL, NULL));
        NOT_NOW(peri_apply_body_force(b, PERI_ALL, v, NULL, NULL));
        NOT_NOW(peri_apply_layer_traction(b, PERI_ALL, 1, v, NULL, NULL));
        NOT_NOW(peri_apply_traction(b, PERI_ALL, 1, v, v, NULL, NULL));
        NOT_NOW(peri_apply_pressure(b, PERI_ALL, 1, NULL, NULL));
        NOT_NOW(peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1, NULL, NULL));
        NOT_NOW(peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 1)));
        NOT_NOW(plane_obstacle(b, zero, v, 0, NULL, NULL));
        NOT_NOW(ball_obstacle(b, zero, 1, 0, NULL, NULL));
        NOT_NOW(peri_remove_obstacle(b, peri_id(b, PERI_KIND_OBSTACLE, 1)));
        NOT_NOW(peri_body_clone(b, &copy, NULL));
        c->wrong += copy != NULL;
    } else {
        c->wrong += peri_body_clone(b, &copy, NULL) != PERI_OK || peri_advance(copy, &run) != PERI_OK;
        peri_body_destroy(copy);
    }
    peri_body_destroy(b);
    free(x);
}

static void meddle(void *user) {
    meddler *c = (meddler *)user;
    if (c->calls++ % 5 || c->quiet) return;
    read_all(c);
    change_all(c);
}

static int32_t in_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)time, (void)count, (void)points, (void)value;
    meddle(user);
    return 0;
}
static int32_t in_motion(void *user, double time, double *place, double *turn) {
    (void)time, (void)place, (void)turn;
    meddle(user);
    return 0;
}
static int32_t in_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    meddler *c = (meddler *)user;
    c->wrong += !(i < j && time > 0 && stretch > 0 && stretch < 1);
    meddle(user);
    return 0;
}
static int32_t in_frame(void *user, peri_body *b) {
    meddler *c = (meddler *)user;
    c->wrong += b != c->body;
    c->frame = 1;
    meddle(user);
    c->frame = 0;
    return 0;
}
static int32_t in_iteration(void *user, int64_t iteration, double residual) {
    meddler *c = (meddler *)user;
    c->wrong += !(iteration > 0 && residual >= 0);
    meddle(user);
    return 0;
}
static void in_log(void *user, int32_t level, const char *text) {
    (void)level, (void)text;
    meddle(user);
}
static int32_t in_write(void *user, const void *bytes, int64_t count) {
    (void)bytes, (void)count;
    meddle(user);
    return 0;
}
static int32_t in_point(void *user, int64_t index, const double *x) {
    (void)x;
    if (index % 16 == 0) meddle(user);
    return 1;
}
static int32_t in_pair(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)xi, (void)xj;
    if ((i + j) % 64 == 0) meddle(user);
    return 0;
}

enum { LOAD, SUPPORT, MOTION, BREAK, FRAME, ITERATION, STEP, LOG, WRITE, POINT, PAIR };

/* The life of a body with one callback; a digest of all that it came to. */
static uint64_t meddled_life(outcome *o, int which, int32_t law, int32_t precision, int quiet) {
    meddler c = {NULL, 0, 0, 0, 0};
    const double hi[3] = {9, 6, 2}, still[3] = {0, 0, 0}, below[3] = {0, -1, 0}, up[3] = {0, 1, 0}, pull[3] = {0.03, 0.004, 0};
    const double edge[3] = {2, 6, 2}, half[3] = {4.5, -1, -1}, end[3] = {99, 99, 99}, nowhere[2] = {-5, -5}, gone[2] = {-5, -4};
    const int32_t criterion = law == PERI_LAW_BOND_BASED ? PERI_CRITERION_STRETCH : law == PERI_LAW_OTERKUS ? PERI_CRITERION_NODE_ENERGY
                            : law == PERI_LAW_LPS ? PERI_CRITERION_BOND_ENERGY : PERI_CRITERION_STRETCH;
    uint64_t hash = DIGEST_START;
    peri_body_desc d;
    peri_material_desc m;
    peri_advance_desc run;
    peri_solve_desc s;
    peri_energy e;
    extreme_desc(&d, law == PERI_LAW_OTERKUS ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, precision, 2.1);
    if (which == LOG) {
        d.log = in_log;
        d.log_user = &c;
    }
    extreme_material(&m, law, 0.2, criterion == PERI_CRITERION_STRETCH ? 0.02 : 0);
    m.criterion = criterion;
    if (criterion != PERI_CRITERION_STRETCH) m.fracture_energy = 2e-4;
    c.quiet = 1;
    peri_body *b = c.body = extreme_box(o, &d, &m, hi, 1);
    c.quiet = quiet;
    if (o->status < 0) {
        *o = extreme_end(*o, b);
        return 0;
    }
    const int32_t axes = PERI_AXIS_XY, set = peri_select_box(b, NULL, still, edge), right = peri_select_box(b, NULL, half, end);
    (void)extreme_fails(o, b, peri_prescribe_velocity(b, set, axes, still, which == SUPPORT ? in_load : NULL, &c));
    (void)extreme_fails(o, b, peri_apply_body_force(b, PERI_ALL, still, which == LOAD ? in_load : NULL, &c));
    (void)extreme_fails(o, b, plane_obstacle(b, below, up, 1, which == MOTION ? in_motion : NULL, &c));
    (void)extreme_fails(o, b, peri_add_velocity(b, right, pull));
    if (which == BREAK) (void)extreme_fails(o, b, peri_on_break(b, in_break, &c));
    if (which == LOG && peri_dimension(b) == 2) /* misses: a remark */
        (void)extreme_fails(o, b, peri_cut_segment(b, PERI_CUT_INITIAL, nowhere, gone));
    if (which == WRITE) (void)extreme_fails(o, b, peri_export_vtu_to(b, in_write, &c));
    if (which == WRITE) (void)extreme_fails(o, b, peri_export_history_to(b, 1, in_write, &c));
    if (which == POINT) (void)extreme_fails(o, b, peri_select_if(b, NULL, in_point, &c));
    if (which == PAIR) (void)extreme_fails(o, b, peri_cut_if(b, PERI_CUT_INITIAL, in_pair, &c));
    peri_advance_desc_init(&run);
    run.steps = 24;
    run.time_step = (which == LOG ? 1.01 : 0.5) * peri_stable_step(b);
    run.force_step = which == LOG; /* a remark, too */
    run.frame_steps = 5;
    run.on_frame = which == FRAME ? in_frame : NULL;
    run.user = &c;
    if (which == LOG) run.steps = 3;
    (void)extreme_fails(o, b, peri_advance(b, &run));
    if (which == BREAK && c.calls != peri_broken_count(b)) *o = scene_spoiled(*o, "breaks told");
    if (peri_get_energy(b, &e) == PERI_OK) scene_digest(&hash, &e.kinetic, 8);
    peri_solve_desc_init(&s);
    s.fracture = 0;
    s.loose = PERI_LOOSE_BALANCED;
    s.steps = 2;
    s.tolerance = precision == PERI_PRECISION_SINGLE ? 1e-2 : 1e-4;
    s.on_iteration = which == ITERATION ? in_iteration : NULL;
    s.on_step = which == STEP ? in_frame : NULL;
    s.user = &c;
    if (which != LOG) {
        (void)extreme_fails(o, b, peri_reset(b));
        (void)extreme_fails(o, b, peri_apply_body_force(b, right, up, NULL, NULL));
        (void)extreme_fails(o, b, peri_solve(b, &s, NULL));
    }
    const int32_t fields[4] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE, PERI_FIELD_FORCE_DENSITY};
    for (int k = 0; k < 4; ++k) {
        double *x = extreme_read(o, b, fields[k]);
        scene_digest(&hash, x, peri_size_of_field(b, fields[k]));
        free(x);
    }
    if (peri_get_energy(b, &e) == PERI_OK) scene_digest(&hash, &e.kinetic, 8);
    if (peri_find_set(b, "meddled") != PERI_ERROR_NAME) *o = scene_spoiled(*o, "a set of a call that was refused");
    if (c.calls == 0) *o = scene_spoiled(*o, "never called");
    if (c.wrong) *o = scene_spoiled(*o, "a call within a callback");
    c.quiet = 1;
    *o = extreme_end(*o, b);
    return hash;
}

static outcome meddling(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    for (int k = 0; k < 4 && o.status >= 0; ++k) {
        const uint64_t quiet = meddled_life(&o, row->choice, scene_laws[k], precision, 1);
        HOLDS(meddled_life(&o, row->choice, scene_laws[k], precision, 0) == quiet);
    }
    return o;
}

/* ---- before the build --------------------------------------------------------------------------------------------- */

static int32_t in_influence(void *user, double q, double *w) {
    meddler *c = (meddler *)user;
    c->calls++;
    if (c->quiet || !c->body) { *w = 1 - 0.5 * q; return 0; }
    const double zero[3] = {0, 0, 0}, far_[3] = {9, 9, 9}, volume = 1;
    const int32_t ids[2] = {0, 1};
    peri_material_desc m;
    extreme_material(&m, PERI_LAW_BOND_BASED, 0, 0);
    NOT_NOW(peri_add_material(c->body, &m));
    NOT_NOW(peri_add_box(c->body, material_id(c->body, 1), zero, far_, 1));
    NOT_NOW(peri_add_points(c->body, 1, far_, &volume, NULL));
    NOT_NOW(peri_set_families(c->body, 1, ids));
    NOT_NOW(peri_build(c->body));
    peri_body_destroy(c->body);
    *w = 1 - 0.5 * q;
    return 0;
}

/* influence_fn that would change the body, asked by peri_get_bond_constants and by peri_build: the body is that of a quiet one. */
static outcome influence_meddles(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double lo[3] = {0, 0, 0}, hi[3] = {6, 5, 4};
    for (int k = 0; k < 4; ++k) {
        double s0[2] = {0, 0}, step[2] = {0, 0};
        for (int quiet = 0; quiet < 2; ++quiet) {
            meddler c = {NULL, 0, 0, quiet, 0};
            peri_body_desc d;
            peri_material_desc m;
            extreme_desc(&d, row->choice, precision, 2.1);
            d.influence = PERI_INFLUENCE_USER;
            d.influence_fn = in_influence;
            d.influence_user = &c;
            extreme_material(&m, scene_laws[k], 0.2, 0);
            m.fracture_energy = 1e-3;
            (void)extreme_fails(&o, NULL, peri_body_create(&d, &c.body, NULL));
            (void)extreme_fails(&o, c.body, peri_add_material(c.body, &m));
            (void)extreme_fails(&o, c.body, peri_get_bond_constants(c.body, material_id(c.body, 1), material_id(c.body, 1), NULL,
                                                                    &s0[quiet]));
            (void)extreme_fails(&o, c.body, peri_add_box(c.body, material_id(c.body, 1), lo, hi, 1));
            (void)extreme_fails(&o, c.body, peri_build(c.body));
            step[quiet] = peri_stable_step(c.body);
            HOLDS(c.wrong == 0 && c.calls > 10 && peri_point_count(c.body) == (row->choice == PERI_SPACE_SOLID ? 120 : 30));
            c.quiet = 1;
            o = extreme_end(o, c.body);
        }
        HOLDS(s0[0] == s0[1] && step[0] == step[1] && step[0] > 0);
    }
    return o;
}

typedef struct wave { /* w(q) = factor, or `odd` in one call of so many                                                   */
    double  factor, odd;
    int64_t every, calls, odds;
} wave;
static int32_t constant_wave(void *user, double q, double *out) {
    wave *w = (wave *)user;
    const int is_odd = w->every && ++w->calls % w->every == 0;
    (void)q;
    w->odds += is_odd;
    *out = is_odd ? w->odd : w->factor;
    return 0;
}

/* Every call of influence_fn, or each other, or each hundredth where there are so many, returns `value`: refused, of each law. */
static outcome influence_writes(const extreme *row, int32_t precision) {
    static const int64_t every[3] = {1, 2, 100};
    outcome o = {PERI_OK, "", 0}, one;
    const double hi[3] = {6, 5, 4};
    for (int k = 0; k < 4 * 3 * 2; ++k) {
        wave w = {1, row->value, every[k / 4 % 3], 0, 0};
        peri_body_desc d;
        peri_material_desc m;
        one.status = PERI_OK;
        one.field = "";
        one.error = 0;
        extreme_desc(&d, k / 12 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, 2.1);
        d.influence = PERI_INFLUENCE_USER;
        d.influence_fn = constant_wave;
        d.influence_user = &w;
        extreme_material(&m, scene_laws[k % 4], 0.2, 0);
        one = extreme_end(one, extreme_box(&one, &d, &m, hi, 1));
        if (w.odds == 0 && one.status == PERI_OK) continue;
        if (scene_laws[k % 4] == PERI_LAW_OTERKUS && w.every == 100 && one.status == PERI_OK) continue; /* only a remark asked so often */
        if (one.status != row->status) return one;
        o = one;
    }
    return o;
}

/* w(q) = value: refused, of each law; by laws that ask for nothing but the families (choice) because these have no weight. */
static outcome influence_all(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double hi[3] = {6, 5, 4};
    for (int k = 0; k < 8; ++k) {
        wave w = {row->value, 0, 0, 0, 0};
        outcome one = {PERI_OK, "", 0};
        peri_body_desc d;
        peri_material_desc m;
        extreme_desc(&d, k / 4 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, 2.1);
        d.influence = PERI_INFLUENCE_USER;
        d.influence_fn = constant_wave;
        d.influence_user = &w;
        extreme_material(&m, scene_laws[k % 4], 0.2, 0);
        one = extreme_end(one, extreme_box(&one, &d, &m, hi, 1));
        if (row->choice && scene_laws[k % 4] != PERI_LAW_BOND_BASED && one.status == PERI_ERROR_FAMILY) one.status = PERI_ERROR_INFLUENCE;
        if (one.status != row->status) return one;
        o = one;
    }
    return o;
}

/* w is dimensionless: a constant factor changes nothing. Forces and the stable step of w = value against those of w = 1. Where bonds are
   single, factors beyond their range may be refused, and only so. */
static outcome influence_factor(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const double hi[3] = {6, 5, 4}, pull[9] = {1e-3, 4e-4, 0, 0, -2e-3, 0, 1e-4, 0, 0}, flat[4] = {1e-3, 4e-4, 0, -2e-3};
    for (int k = 0; k < 8; ++k) {
        double *f[2] = {NULL, NULL}, step[2] = {1, 1}, largest = 0;
        int64_t n = 0;
        int refused = 0;
        for (int scaled = 0; scaled < 2; ++scaled) {
            wave w = {scaled ? row->value : 1, 0, 0, 0, 0};
            outcome one = {PERI_OK, "", 0};
            peri_body_desc d;
            peri_material_desc m;
            extreme_desc(&d, k / 4 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, 2.1);
            d.influence = PERI_INFLUENCE_USER;
            d.influence_fn = constant_wave;
            d.influence_user = &w;
            extreme_material(&m, scene_laws[k % 4], 0.3, 0);
            if (k % 4 == 0) m.poisson = NAN;
            peri_body *b = extreme_box(&one, &d, &m, hi, 1);
            refused = one.status == PERI_ERROR_INFLUENCE && scaled;
            if (one.status == PERI_OK) {
                extreme_affine(&one, b, k / 4 ? pull : flat, NULL);
                f[scaled] = extreme_read(&one, b, PERI_FIELD_FORCE_DENSITY);
                n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY);
                step[scaled] = peri_stable_step(b);
            }
            one = extreme_end(one, b);
            if (one.status < 0 && !refused) {
                one.error = k;
                return one;
            }
        }
        HOLDS(!refused || precision != PERI_PRECISION_DOUBLE);
        for (int64_t i = 0; f[0] && i < n; ++i) largest = fmax(largest, fabs(f[0][i]));
        for (int64_t i = 0; f[0] && f[1] && i < n; ++i) o.error = extreme_worst(o.error, fabs(f[1][i] - f[0][i]) / largest);
        if (!refused) o.error = extreme_worst(o.error, fabs(step[1] / step[0] - 1));
        free(f[0]);
        free(f[1]);
    }
    return o;
}

/* ---- values ------------------------------------------------------------------------------------------------------- */

typedef struct writer { /* writes `value` into one component once `time` is reached                                       */
    double value, time;
    int    dim, silent;
} writer;

static int32_t write_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const writer *w = (const writer *)user;
    (void)points;
    if (!w->silent && time >= w->time) value[count * w->dim - 1] = w->value;
    return 0;
}
static int32_t write_place(void *user, double time, double *place, double *turn) {
    (void)turn;
    const writer *w = (const writer *)user;
    if (!w->silent && time >= w->time) place[w->dim - 1] = w->value;
    return 0;
}

enum { SURFACE, BODY_FORCE, TRACTION, DISPLACEMENT, VELOCITY, PLANE, BALL, KINDS };

/* A load, support or obstacle that follows a callback. */
static void add_written(outcome *o, peri_body *b, int kind, writer *w) {
    const int dim = peri_dimension(b), axes = dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    const double v[3] = {1e-3, -2e-3, 0}, below[3] = {0, -3, -3}, up[3] = {0, dim == 2, dim == 3};
    const double left[3] = {-9, -9, -9}, edge[3] = {4.6, 99, 99}, normal[3] = {-1, 0, 0};
    const int32_t set = kind == PLANE || kind == BALL ? 0 : peri_select_box(b, NULL, left, edge);
    switch (kind) {
    case BODY_FORCE: (void)extreme_fails(o, b, peri_apply_body_force(b, PERI_ALL, v, write_load, w)); break;
    case TRACTION: (void)extreme_fails(o, b, peri_apply_layer_traction(b, set, 5, v, write_load, w)); break;
    case SURFACE: (void)extreme_fails(o, b, peri_apply_traction(b, set, dim == 3 ? 15 : 5, normal, v, write_load, w)); break;
    case DISPLACEMENT: (void)extreme_fails(o, b, peri_prescribe_displacement(b, set, axes, v, write_load, w)); break;
    case VELOCITY: (void)extreme_fails(o, b, peri_prescribe_velocity(b, set, axes, v, write_load, w)); break;
    case PLANE: (void)extreme_fails(o, b, plane_obstacle(b, below, up, 1, write_place, w)); break;
    default: (void)extreme_fails(o, b, ball_obstacle(b, below, 1, 1, write_place, w)); break;
    }
}

static peri_body *written_body(outcome *o, int32_t law, int32_t precision) {
    const double hi[3] = {9, 5, 3};
    peri_body_desc d;
    peri_material_desc m;
    extreme_desc(&d, law == PERI_LAW_LPS ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, precision, 2.1);
    extreme_material(&m, law, 0.2, 0);
    return extreme_box(o, &d, &m, hi, 1);
}

static uint64_t state_of(outcome *o, peri_body *b) {
    uint64_t hash = DIGEST_START;
    peri_energy e;
    double *u = extreme_read(o, b, PERI_FIELD_DISPLACEMENT), *v = extreme_read(o, b, PERI_FIELD_VELOCITY);
    scene_digest(&hash, u, peri_size_of_field(b, PERI_FIELD_DISPLACEMENT));
    scene_digest(&hash, v, peri_size_of_field(b, PERI_FIELD_VELOCITY));
    if (!extreme_fails(o, b, peri_get_energy(b, &e))) scene_digest(&hash, &e.kinetic, 8);
    free(u);
    free(v);
    return hash;
}

/* The kinds of the row's range, each with each law, writing `value` after a third of a run of 12 steps. After PERI_ERROR_* the body is
   reset, and the run made again with a callback that holds still: the bits of a body that never saw the number. */
static outcome writes_value(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0}, one;
    for (int k = 0; k < 4 * KINDS; ++k) {
        const int kind = k / 4;
        uint64_t told = 0, quiet = 0;
        int32_t ended = 0;
        if (kind < row->choice / 10 || kind > row->choice % 10) continue;
        one.status = PERI_OK;
        one.field = "";
        one.error = 0;
        for (int fresh = 0; fresh < 2; ++fresh) {
            writer w = {row->value, 0, 0, fresh};
            outcome after = {PERI_OK, "", 0};
            peri_body *b = written_body(&after, scene_laws[k % 4], precision);
            peri_advance_desc run;
            w.dim = peri_dimension(b);
            peri_advance_desc_init(&run);
            run.steps = 12;
            run.time_step = 0.5 * peri_stable_step(b);
            w.time = 3.7 * run.time_step;
            add_written(&after, b, kind, &w);
            run.time_step = 0.5 * peri_stable_step(b);
            if (!fresh) {
                (void)extreme_fails(&one, b, ended = peri_advance(b, &run));
                if (row->status < 0) HOLDS(peri_step_count(b) >= 3 && peri_step_count(b) <= 12);
                w.silent = 1;
                (void)extreme_fails(&after, b, peri_reset(b));
            }
            (void)extreme_fails(&after, b, peri_advance(b, &run));
            *(fresh ? &quiet : &told) = state_of(&after, b);
            after = extreme_end(after, b);
            if (after.status != PERI_OK) return after;
        }
        HOLDS(told == quiet && ended == row->status);
        if (o.status == SPOILED || one.status != row->status) return one.status != row->status ? one : o;
        o = one;
    }
    return o;
}

/* A callback that writes nothing, or adds a denormal number to a component that is 0: a load without a callback. */
static outcome writes_nothing(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    for (int k = 0; k < 4 * KINDS; ++k) {
        double *u[2] = {NULL, NULL}, largest = 1e-30;
        int64_t n = 0;
        if (k / 4 == SURFACE) continue;
        for (int silent = 0; silent < 2; ++silent) {
            writer w = {row->value, 0, 0, silent};
            peri_body *b = written_body(&o, scene_laws[k % 4], precision);
            peri_advance_desc run;
            w.dim = peri_dimension(b);
            if (w.dim == 2 && k / 4 != PLANE && k / 4 != BALL) w.silent = 1; /* the last component is not 0 there */
            if (k / 4 == PLANE || k / 4 == BALL) w.time = 1e300;
            add_written(&o, b, k / 4, &w);
            peri_advance_desc_init(&run);
            run.steps = 12;
            (void)extreme_fails(&o, b, peri_advance(b, &run));
            u[silent] = extreme_read(&o, b, PERI_FIELD_DISPLACEMENT);
            n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
            o = extreme_end(o, b);
        }
        for (int64_t i = 0; u[0] && u[1] && i < n; ++i) largest = fmax(largest, fabs(u[1][i]));
        for (int64_t i = 0; u[0] && u[1] && i < n; ++i) o.error = extreme_worst(o.error, fabs(u[0][i] - u[1][i]) / largest);
        free(u[0]);
        free(u[1]);
    }
    return o;
}

static const char *const order = "peri.h: callbacks may read; changes are PERI_ERROR_ORDER, destroying is ignored: bits of a quiet life";
static const char *const infinite = "peri.h: a callback wrote a number that is not finite; after peri_reset the body is as if it had not";
static const char *const weight = "peri.h: the influence function is not finite, or has no finite moments to calibrate with";
static const char *const far_off = "peri.h: a point is faster than 1e9 speeds of sound or not finite; after peri_reset as if it had not";
static const char *const limits = "peri.h: sums of w beyond 1e100 or below 1e-100 are refused, so is what has no moments";
static const char *const factor = "peri.h: constant factors cancel in every law";

#define RANGE(first, last) (10 * (first) + (last))
static const extreme rows[] = {
    {"a load that meddles", order, meddling, 0, 0, LOAD, PERI_OK, NULL, {0, 0, 0}},
    {"a support that meddles", order, meddling, 0, 0, SUPPORT, PERI_OK, NULL, {0, 0, 0}},
    {"a moving obstacle that meddles", order, meddling, 0, 0, MOTION, PERI_OK, NULL, {0, 0, 0}},
    {"on_break meddles", order, meddling, 0, 0, BREAK, PERI_OK, NULL, {0, 0, 0}},
    {"on_frame meddles", order, meddling, 0, 0, FRAME, PERI_OK, NULL, {0, 0, 0}},
    {"on_iteration meddles", order, meddling, 0, 0, ITERATION, PERI_OK, NULL, {0, 0, 0}},
    {"on_step meddles", order, meddling, 0, 0, STEP, PERI_OK, NULL, {0, 0, 0}},
    {"the log meddles", order, meddling, 0, 0, LOG, PERI_OK, NULL, {0, 0, 0}},
    {"a writer meddles", order, meddling, 0, 0, WRITE, PERI_OK, NULL, {0, 0, 0}},
    {"a selection meddles", order, meddling, 0, 0, POINT, PERI_OK, NULL, {0, 0, 0}},
    {"a cut meddles", order, meddling, 0, 0, PAIR, PERI_OK, NULL, {0, 0, 0}},
    {"influence_fn meddles, 2D", order, influence_meddles, 0, 0, PERI_SPACE_PLANE_STRESS, PERI_OK, NULL, {0, 0, 0}},
    {"influence_fn meddles, 3D", order, influence_meddles, 0, 0, PERI_SPACE_SOLID, PERI_OK, NULL, {0, 0, 0}},
    {"influence_fn writes NaN, always or now and then", weight, influence_writes, NAN, 0, 0, PERI_ERROR_INFLUENCE, "influence", {0, 0, 0}},
    {"influence_fn writes infinity", weight, influence_writes, HUGE_VAL, 0, 0, PERI_ERROR_INFLUENCE, "influence", {0, 0, 0}},
    {"influence_fn writes -infinity", weight, influence_writes, -HUGE_VAL, 0, 0, PERI_ERROR_INFLUENCE, "influence", {0, 0, 0}},
    /* u of the bonds' weights, a hundred of them in a point */
    {"influence_fn 1e30", factor, influence_factor, 1e30, 0, 0, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    {"influence_fn 1e-30", factor, influence_factor, 1e-30, 0, 0, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    {"influence_fn 1e45", factor, influence_factor, 1e45, 0, 0, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    {"influence_fn 1e-45", factor, influence_factor, 1e-45, 0, 0, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    {"influence_fn 1e90", factor, influence_factor, 1e90, 0, 0, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    {"influence_fn 1e-90", factor, influence_factor, 1e-90, 0, 0, PERI_OK, NULL, {1e-12, 1e-4, 1e-3}},
    {"influence_fn 1e300", limits, influence_all, 1e300, 0, 0, PERI_ERROR_INFLUENCE, NULL, {0, 0, 0}},
    {"influence_fn 1e-300", limits, influence_all, 1e-300, 0, 1, PERI_ERROR_INFLUENCE, NULL, {0, 0, 0}},
    {"influence_fn 5e-324", limits, influence_all, 5e-324, 0, 1, PERI_ERROR_INFLUENCE, NULL, {0, 0, 0}},
    {"influence_fn -1", "a negative factor has no stiffness to calibrate", influence_all, -1, 0, 0, PERI_ERROR_INFLUENCE, NULL, {0, 0, 0}},
    {"loads and supports write NaN", infinite, writes_value, NAN, 0, RANGE(SURFACE, VELOCITY), PERI_ERROR_CALLBACK,
     "value", {0, 0, 0}},
    {"loads and supports write infinity", infinite, writes_value, HUGE_VAL, 0, RANGE(SURFACE, VELOCITY), PERI_ERROR_CALLBACK,
     "value", {0, 0, 0}},
    {"obstacles write NaN", infinite, writes_value, NAN, 0, RANGE(PLANE, BALL), PERI_ERROR_CALLBACK, "place", {0, 0, 0}},
    {"obstacles write -infinity", infinite, writes_value, -HUGE_VAL, 0, RANGE(PLANE, BALL), PERI_ERROR_CALLBACK, "place",
     {0, 0, 0}},
    {"loads and supports write 1e30", far_off, writes_value, 1e30, 0, RANGE(BODY_FORCE, VELOCITY), PERI_ERROR_UNSTABLE, "peri_time",
     {0, 0, 0}},
    {"loads and supports write -1e18", far_off, writes_value, -1e18, 0, RANGE(BODY_FORCE, VELOCITY), PERI_ERROR_UNSTABLE, "peri_time",
     {0, 0, 0}},
    {"a plane in which all lies 1e30 deep", far_off, writes_value, 1e30, 0, RANGE(PLANE, PLANE), PERI_ERROR_UNSTABLE, "peri_time",
     {0, 0, 0}},
    {"a ball 1e300 away", "it touches nothing", writes_value, 1e300, 0, RANGE(BALL, BALL), PERI_OK, NULL, {0, 0, 0}},
    {"callbacks that write nothing", "peri.h: value holds the constant at entry", writes_nothing, 0, 0, 0, PERI_OK, NULL, {0, 0, 0}},
    {"callbacks that write a denormal number", "5e-324 is nothing beside 1e-3", writes_nothing, 5e-324, 0, 0, PERI_OK, NULL,
     {1e-300, 1e-300, 1e-300}},
};
const extreme_table extreme_callbacks = EXTREME_TABLE("callbacks", rows);
