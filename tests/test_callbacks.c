/* SPDX-License-Identifier: MIT */
/* test_callbacks.c - every callback x {fails, asks to stop, is left by a jump} x the calls that make it.

   SOURCE OF TRUTH: peri.h (< 0: PERI_ERROR_CALLBACK, its value what was returned, its field the type of the callback; > 0: PERI_STOPPED at
   a whole step; what failed has changed nothing, unless said; a body left by a jump is unlocked, then read, reset, destroyed); conservation
   of blocks (the bytes that the allocator has given out are those of peri_get_memory, and none after peri_body_destroy); and other runs of
   the library: a run that is stopped after k steps is a run of k steps, and a body that was reset is a fresh one, bit by bit. */
#include "peri_test.h"
#include <setjmp.h>

/* ---- the allocator: counts what is out ------------------------------------------------------------------------------ */

static int64_t blocks, bytes;

static void *take(void *user, uint64_t size) {
    (void)user;
    ++blocks;
    bytes += (int64_t)size;
    return malloc((size_t)size);
}
static void give(void *user, void *pointer, uint64_t size) {
    (void)user;
    --blocks;
    bytes -= (int64_t)size;
    free(pointer);
}

/* ---- callbacks: each says 0 but at one call, where it trips ---------------------------------------------------------- */

enum kind { LOAD, SUPPORT, MOTION, BREAK, FRAME, STEP, ITERATION, INFLUENCE, POINT, PAIR, WRITE, LOG, KINDS };
enum what { FAIL = -7, STOP = 3, JUMP = 1000 };
static const char *const type_of[KINDS] = {"peri_load_fn", "peri_load_fn", "peri_motion_fn", "peri_break_fn", "peri_frame_fn",
                                           "peri_frame_fn", "peri_iteration_fn", "peri_influence_fn", "peri_point_fn", "peri_pair_fn",
                                           "write", ""};
static struct {
    int     kind, what;
    int64_t at, calls[KINDS];
    jmp_buf out;
} trip;
static double trip_time;  /* of the break that tripped */
static double rate;       /* of the right grip, per time */
static int    nests, cuts; /* on_frame and on_step select and cut by predicates */

static void no_trip(void) {
    memset(trip.calls, 0, sizeof trip.calls);
    trip.kind = -1;
}
static int32_t say(int kind) {
    const int trips = ++trip.calls[kind] == trip.at && kind == trip.kind;
    if (trips && trip.what == JUMP) longjmp(trip.out, 1);
    return trips ? trip.what : 0;
}
static int32_t load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)user, (void)points;
    for (k = 0; k < count; ++k) value[2 * k] = 1e-5 * time;
    return say(LOAD);
}
static int32_t support(void *user, double time, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    (void)user, (void)points;
    for (k = 0; k < count; ++k) value[2 * k] = rate * time;
    return say(SUPPORT);
}
static int32_t still(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)time, (void)count, (void)points, (void)value;
    return say(SUPPORT);
}
static int32_t motion(void *user, double time, double *place, double *turn) {
    (void)user, (void)turn;
    place[1] = -0.52 + 0.04 * rate * time;
    return say(MOTION);
}
static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    const int32_t said = say(BREAK);
    (void)user;
    CHECK(i < j && stretch > 0);
    if (said) trip_time = time;
    return said;
}
static int32_t take_left(void *user, int64_t index, const double *x) {
    const int32_t said = say(POINT);
    (void)user, (void)index;
    return said ? said : x[0] < 5;
}
static int32_t cut_few(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const int32_t said = say(PAIR);
    (void)user, (void)xi, (void)xj;
    return said ? said : i % 5 == 0 && j % 3 == 0;
}
static int32_t nest(peri_body *b, int32_t said) {
    if (nests && peri_select_if(b, NULL, take_left, NULL) == PERI_ERROR_CALLBACK) return -5;
    if (nests && cuts++ == 0 && peri_cut_if(b, PERI_CUT_NOW, cut_few, NULL) == PERI_ERROR_CALLBACK) return -5;
    return said;
}
static int32_t on_frame(void *user, peri_body *b) {
    (void)user;
    return nest(b, say(FRAME));
}
static int32_t on_step(void *user, peri_body *b) {
    (void)user;
    return nest(b, say(STEP));
}
static int32_t on_iteration(void *user, int64_t iteration, double residual) {
    (void)user, (void)iteration, (void)residual;
    return say(ITERATION);
}
static int32_t influence(void *user, double q, double *w) {
    (void)user;
    *w = 1 - 0.5 * q;
    return say(INFLUENCE);
}
static int32_t write_bytes(void *user, const void *from, int64_t count) {
    (void)user, (void)from, (void)count;
    return say(WRITE);
}
static void log_text(void *user, int32_t level, const char *text) {
    (void)user, (void)level, (void)text;
    (void)say(LOG);
}

/* ---- the body ------------------------------------------------------------------------------------------------------- */

enum form { COLUMNS, CLOUD, CORRECTED, FORMS }; /* bond-based on a lattice; LPS on moved points; bond-based with corrected weights */

static peri_body *start(int form) {
    const double lo[2] = {0, 0}, hi[2] = {14, 8};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    int32_t id;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 2.5;
    d.influence = PERI_INFLUENCE_USER;
    d.influence_fn = influence;
    d.correction = form == CORRECTED ? PERI_CORRECTION_MOMENT : PERI_CORRECTION_NONE;
    d.allocate = take;
    d.release = give;
    d.log = log_text;
    d.threads = 1;
    d.number = 5;
    CHECK(peri_body_create(&d, &b, NULL) == PERI_OK);
    peri_material_desc_init(&m, form == CLOUD ? PERI_LAW_LPS : PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    if (form == CLOUD) m.poisson = 0.3;
    m.critical_stretch = 0.02;
    id = (int32_t)MUST(b, peri_add_material(b, &m));
    if (form == CLOUD) MUST(b, peri_add_perturbed_box(b, id, lo, hi, 1, 0.5, 1));
    else MUST(b, peri_add_box(b, id, lo, hi, 1));
    return b;
}
static void equip(peri_body *b) {
    const double lo[2] = {0, 0}, left[2] = {2.5, 8}, right[2] = {11.5, 0}, hi[2] = {14, 8}, up[2] = {0, 1}, below[2] = {0, -0.52};
    const double from[2] = {7, 8}, to[2] = {7, 5};
    int32_t grip[2];
    MUST(b, peri_build(b));
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    grip[0] = (int32_t)MUST(b, peri_select_box(b, "left", lo, left));
    grip[1] = (int32_t)MUST(b, peri_select_box(b, "right", right, hi));
    MUST(b, peri_prescribe_velocity(b, grip[0], PERI_AXIS_XY, NULL, still, NULL)); /* asked for wherever forces are made */
    MUST(b, peri_prescribe_displacement(b, grip[1], PERI_AXIS_XY, NULL, support, NULL));
    MUST(b, peri_set_no_fail(b, grip[0], 1));
    MUST(b, peri_set_no_fail(b, grip[1], 1));
    MUST(b, peri_apply_body_force(b, PERI_ALL, NULL, load, NULL));
    MUST(b, plane_obstacle(b, below, up, 0.1, motion, NULL));
    MUST(b, peri_on_break(b, on_break, NULL));
}
static peri_body *whole(int form) {
    peri_body *b = start(form);
    equip(b);
    return b;
}

static uint64_t mix(uint64_t hash, const void *from, size_t count) {
    const unsigned char *at = (const unsigned char *)from;
    for (; count > 0; --count) hash = (hash ^ *at++) * UINT64_C(1099511628211);
    return hash;
}
/* Of all that a run moves. */
static uint64_t digest(peri_body *b) {
    static const int32_t fields[3] = {PERI_FIELD_DISPLACEMENT, PERI_FIELD_VELOCITY, PERI_FIELD_DAMAGE};
    const int64_t counts[2] = {peri_broken_count(b), peri_cut_count(b)};
    uint64_t hash = mix(UINT64_C(14695981039346656037), counts, sizeof counts);
    double x[2 * 112];
    peri_energy e;
    int k;
    MUST(b, peri_get_energy(b, &e));
    hash = mix(hash, &e, sizeof e);
    for (k = 0; k < 3; ++k) {
        MUST(b, peri_get_field(b, fields[k], x, 2 * 112));
        hash = mix(hash, x, (size_t)peri_size_of_field(b, fields[k]) * sizeof *x);
    }
    return hash;
}
/* Forces follow from where the body is: moving it by nothing has them made anew. */
static int force_is_of_the_state(peri_body *b) {
    const double nothing[2] = {0, 0};
    double f[2 * 112], g[2 * 112];
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 2 * 112));
    MUST(b, peri_add_displacement(b, PERI_ALL, nothing));
    MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, g, 2 * 112));
    return memcmp(f, g, sizeof f) == 0;
}
static int64_t total(const peri_body *b) {
    peri_memory m;
    CHECK(peri_get_memory(b, &m) == PERI_OK);
    return m.total;
}

/* ---- the calls ------------------------------------------------------------------------------------------------------ */

enum call { BUILD, CONSTANTS, SHAPE, SELECT, CUT_IF, CUT_NONE, VTU, HISTORY, FORCE, REACTION, PUSH, VIEW, MATRIX, PRODUCT, /* runs: */
            VERLET, CENTRAL, NESTED, NEWTON, BICGSTAB, RELAX, NESTED_SOLVE, CALLS };
static const char *const call_name[CALLS] = {"build", "constants", "shape", "select", "cut_if", "cut_none", "vtu", "history", "force",
                                             "reaction", "push", "view", "matrix", "product", "verlet", "central", "nested", "newton",
                                             "bicgstab", "relax", "nested_solve"};
#define IS_RUN(call)    ((call) >= VERLET)
#define IS_SOLVE(call)  ((call) >= NEWTON)
#define BEFORE_BUILD(call) ((call) == BUILD || (call) == SHAPE)

static peri_solve_report solved;

static int32_t advance(peri_body *b, int32_t integrator, int64_t steps) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.integrator = integrator;
    r.steps = steps;
    r.time_step = 0.4;
    r.frame_steps = 5;
    r.on_frame = on_frame;
    return peri_advance(b, &r);
}
static int32_t solve(peri_body *b, int32_t method, double load_to, int64_t steps) {
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    s.method = method;
    s.loose = PERI_LOOSE_PINNED;
    s.criticality = 0; /* all at once: few equilibria */
    s.load_to = load_to;
    s.steps = steps;
    s.on_iteration = on_iteration;
    s.on_step = on_step;
    return peri_solve(b, &s, &solved);
}
static const int32_t method_of[CALLS] = {[NEWTON] = PERI_METHOD_NEWTON, [BICGSTAB] = PERI_METHOD_BICGSTAB,
                                         [RELAX] = PERI_METHOD_RELAXATION, [NESTED_SOLVE] = PERI_METHOD_NEWTON};

static int64_t call(peri_body *b, int which) {
    const double lo[2] = {20, 0}, hi[2] = {24, 4}, far[2] = {30, 31};
    double x[2 * 112] = {0}, f[2], s0;
    peri_matrix *matrix = NULL;
    peri_view view;
    rate = IS_SOLVE(which) ? 0.5 : 0.02;
    nests = which == NESTED || which == NESTED_SOLVE;
    cuts = 0;
    switch (which) {
    case BUILD: return peri_build(b);
    case CONSTANTS: return peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), NULL, &s0);
    case SHAPE: return peri_add_shape(b, peri_id(b, PERI_KIND_MATERIAL, 1), lo, hi, 1, take_left, NULL);
    case SELECT: return peri_select_if(b, "chosen", take_left, NULL);
    case CUT_IF: return peri_cut_if(b, PERI_CUT_NOW, cut_few, NULL);
    case CUT_NONE: return peri_cut_segment(b, PERI_CUT_NOW, far, lo);
    case VTU: return peri_export_vtu_to(b, write_bytes, NULL);
    case HISTORY: return peri_export_history_to(b, 1, write_bytes, NULL);
    case FORCE: return peri_get_field(b, PERI_FIELD_FORCE_DENSITY, x, 2 * 112);
    case REACTION: return peri_get_reaction(b, peri_id(b, PERI_KIND_LOAD, 3), f);
    case PUSH: return peri_get_obstacle_force(b, peri_id(b, PERI_KIND_OBSTACLE, 1), f, NULL);
    case VIEW: return peri_view_field(b, PERI_FIELD_REACTION, &view);
    case MATRIX: {
        const int32_t made = peri_matrix_create(b, &matrix);
        peri_matrix_destroy(matrix);
        return made;
    }
    case PRODUCT: return peri_multiply_stiffness(b, x, x, 2 * 112);
    case VERLET: case NESTED: return advance(b, PERI_INTEGRATOR_VELOCITY_VERLET, 43);
    case CENTRAL: return advance(b, PERI_INTEGRATOR_CENTRAL_DIFFERENCE, 43);
    default: return solve(b, method_of[which], 1, 4);
    }
}
/* The call, or -1000 where a jump left it. */
static int64_t leap(peri_body *b, int which) {
    return setjmp(trip.out) == 0 ? call(b, which) : -1000;
}

/* What the body makes of itself: a run after a reset. */
static uint64_t life(peri_body *b) {
    no_trip();
    rate = 0.02;
    nests = 0;
    CHECK(MUST(b, peri_reset(b)) == PERI_OK);
    MUST(b, advance(b, PERI_INTEGRATOR_VELOCITY_VERLET, 30));
    CHECK(peri_broken_count(b) > 10);
    return digest(b);
}
static uint64_t fresh_life[FORMS];

static void end(peri_body *b) {
    peri_body_destroy(b);
    CHECK(blocks == 0 && bytes == 0);
    blocks = bytes = 0;
}
static peri_body *ready(int form, int which) {
    peri_body *b;
    no_trip();
    b = start(form);
    if (which == CONSTANTS || BEFORE_BUILD(which)) return b;
    equip(b);
    return b;
}

/* ---- the table ------------------------------------------------------------------------------------------------------- */

static int tried, told;

static void tell(int form, int which, int kind, int64_t result) {
    if (test_bad == told || test_bad > 10) return;
    told = test_bad;
    printf("    form %d, %s, kind %d, %d at call %d: %d\n", form, call_name[which], kind, trip.what, (int)trip.at, (int)result);
}

/* After whatever happened: the bytes are those of the body, and a reset makes it new. */
static void goes_on(peri_body *b, int form, int which) {
    no_trip();
    CHECK(total(b) == bytes);
    if (which == CONSTANTS || BEFORE_BUILD(which)) equip(b);
    CHECK(life(b) == fresh_life[form]);
    CHECK(total(b) == bytes);
    end(b);
}

static void fails(int form, int which, int kind, int64_t at) {
    peri_body *b = ready(form, which);
    const int64_t held = total(b), sets = which == SELECT ? 3 : 1, points = peri_point_count(b);
    const int within = IS_RUN(which) && (kind == LOAD || kind == SUPPORT || kind == MOTION || kind == ITERATION);
    const uint64_t before = peri_family_width(b) > 0 ? digest(b) : 0;
    peri_error e;
    int64_t result;
    no_trip();
    trip.kind = kind;
    trip.what = FAIL;
    trip.at = at;
    result = call(b, which);
    CHECK(result == (kind == WRITE ? PERI_ERROR_WRITE : PERI_ERROR_CALLBACK));
    CHECK(peri_get_error(b, &e) == PERI_OK && e.code == result && strcmp(e.field, kind == POINT && IS_RUN(which) ? "peri_frame_fn" :
          kind == PAIR && IS_RUN(which) ? "peri_frame_fn" : type_of[kind]) == 0);
    CHECK(kind == WRITE || e.value == ((kind == POINT || kind == PAIR) && IS_RUN(which) ? -5 : FAIL));
    if (kind != WRITE) CHECK(trip.calls[kind] == at); /* it is not called again */
    if (!IS_RUN(which)) { /* nothing has changed */
        CHECK(total(b) == held + (which == PRODUCT ? total(b) - held : 0) && peri_point_count(b) == points);
        CHECK(sets != 3 || peri_id(b, PERI_KIND_SET, 3) == PERI_ERROR_ID_GONE);
        CHECK(before == 0 || digest(b) == before);
        CHECK(!BEFORE_BUILD(which) || peri_family_width(b) == 0);
    } else if (!within && !IS_SOLVE(which) && !nests) { /* a whole step */
        peri_body *other = ready(form, which);
        no_trip();
        MUST(other, advance(other, which == CENTRAL ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET,
                            peri_step_count(b)));
        CHECK(digest(b) == digest(other) && peri_time(b) == peri_time(other));
        peri_body_destroy(other);
    }
    tell(form, which, kind, result);
    goes_on(b, form, which);
    tried++;
}

static void stops(int form, int which, int kind, int64_t at) {
    peri_body *b = ready(form, which), *other;
    int64_t result, steps;
    no_trip();
    trip.kind = kind;
    trip.what = STOP;
    trip.at = at;
    result = call(b, which);
    CHECK(result == PERI_STOPPED);
    steps = peri_step_count(b);
    if (kind <= MOTION && !IS_SOLVE(which)) /* not a step more; of two supports the other may be asked */
        CHECK(trip.calls[kind] == at || (kind == SUPPORT && trip.calls[kind] == at + 1));
    if (kind == BREAK && !IS_SOLVE(which)) CHECK(peri_time(b) == trip_time);
    CHECK(steps <= (IS_SOLVE(which) ? 4 : 43));
    if (!nests && (kind == BREAK || kind == STEP || !IS_SOLVE(which))) { /* at a whole step, every break of it reported */
        const int64_t calls = trip.calls[BREAK];
        other = ready(form, which);
        no_trip();
        rate = IS_SOLVE(which) ? 0.5 : 0.02;
        if (IS_SOLVE(which)) MUST(other, solve(other, method_of[which], 0.25 * (double)steps, steps));
        else if (steps > 0)
            MUST(other, advance(other, which == CENTRAL ? PERI_INTEGRATOR_CENTRAL_DIFFERENCE : PERI_INTEGRATOR_VELOCITY_VERLET, steps));
        CHECK(digest(b) == digest(other) && peri_time(b) == peri_time(other) && trip.calls[BREAK] == calls);
        CHECK(!IS_SOLVE(which) || (solved.residual <= 1e-8 && peri_load_factor(b) == 0.25 * (double)steps));
        peri_body_destroy(other);
    }
    tell(form, which, kind, result);
    goes_on(b, form, which);
    tried++;
}

static void jumps(int form, int which, int kind, int64_t at) {
    peri_body *b = ready(form, which), *copy = NULL;
    const uint64_t before = peri_family_width(b) > 0 ? digest(b) : 0;
    peri_advance_desc r;
    peri_energy e;
    int64_t result, held;
    uint64_t copied = 0;
    if (before && at % 2 == 0) {
        CHECK(peri_body_clone(b, &copy, NULL) == PERI_OK);
        rate = 0.02;
        MUST(copy, advance(copy, PERI_INTEGRATOR_VELOCITY_VERLET, 3));
        copied = digest(copy);
    }
    held = bytes;
    no_trip();
    trip.kind = kind;
    trip.what = JUMP;
    trip.at = at;
    result = leap(b, which);
    CHECK(result == -1000);
    peri_advance_desc_init(&r);
    r.steps = 1;
    CHECK(peri_advance(b, &r) == PERI_ERROR_ORDER && peri_reset(b) == PERI_ERROR_ORDER);
    peri_body_destroy(b); /* ignored */
    CHECK(peri_unlock(b) == PERI_OK);
    no_trip();
    if (tried % 3 == 2 && !copy) { /* it may be destroyed at once */
        tell(form, which, kind, result);
        end(b);
        tried++;
        return;
    }
    if (!IS_RUN(which) && which != PRODUCT && which != CUT_NONE) CHECK(bytes == held && (before == 0 || digest(b) == before));
    if (before) { /* it may be read */
        MUST(b, peri_get_energy(b, &e));
        (void)digest(b);
        CHECK(force_is_of_the_state(b));
    }
    if (IS_RUN(which)) CHECK(peri_advance(b, &r) == PERI_ERROR_ORDER && solve(b, PERI_METHOD_NEWTON, 1, 1) == PERI_ERROR_ORDER);
    CHECK(peri_unlock(b) == PERI_ERROR_ORDER);
    if (copy) {
        CHECK(digest(copy) == copied);
        CHECK(life(copy) == fresh_life[form]);
        peri_body_destroy(copy);
    }
    tell(form, which, kind, result);
    goes_on(b, form, which);
    tried++;
}

/* Does this kind come in this call, and may it stop it? */
static int64_t count_calls(int form, int which, int kind) {
    peri_body *b = ready(form, which);
    int64_t result, count;
    no_trip();
    result = call(b, which);
    count = trip.calls[kind];
    if (which != SHAPE) CHECK(MUST(b, result) >= 0); /* which is right of where take_left takes */
    end(b);
    return count;
}

/* Where in a call a callback is tripped: at the first, a middle, the last time that it is called. All with --long. */
enum trips { FIRST = 1, MIDDLE = 2, LAST = 4 };

static void one_call(int form, int which, int trips) {
    int kind;
    for (kind = 0; kind < KINDS; ++kind) {
        const int64_t count = count_calls(form, which, kind);
        const int64_t at[3] = {1, (count + 1) / 2, count};
        int k;
        for (k = 0; k < 3; ++k) {
            if (count == 0 || (k > 0 && at[k] == at[k - 1]) || !(trips >> k & 1)) continue;
            jumps(form, which, kind, at[k]);
            if (kind == LOG) continue; /* it returns nothing */
            fails(form, which, kind, at[k]);
            if (IS_RUN(which) && kind < INFLUENCE && !nests && (k < 2 || kind == LOAD)) stops(form, which, kind, at[k]);
        }
    }
}

/* The calls from `from` to before `end`; of a table less than `least` cases would be one in which calls make no callbacks. */
static void table(int form, int trips, int from, int end_call, int least) {
    int which;
    peri_body *b;
    no_trip();
    b = whole(form);
    fresh_life[form] = life(b);
    end(b);
    tried = 0;
    for (which = from; which < end_call; ++which)
        if (form == COLUMNS || (which != BICGSTAB && which != RELAX)) one_call(form, which, trips); /* the same on any form, and slow */
    printf("    %d cases\n", tried);
    CHECK(tried > least);
}
static void first_calls(void) { table(COLUMNS, FIRST, BUILD, NEWTON, 70); }
static void first_calls_of_newton(void) { table(COLUMNS, FIRST, NEWTON, BICGSTAB, 15); }
static void first_calls_of_other_solves(void) { table(COLUMNS, FIRST, BICGSTAB, CALLS, 50); }
static void last_calls(void) { table(COLUMNS, test_long ? MIDDLE | LAST : LAST, BUILD, NEWTON, 40); }
static void last_calls_of_solves(void) { table(COLUMNS, test_long ? MIDDLE | LAST : LAST, NEWTON, CALLS, 50); }
static void on_a_list(void) { table(CLOUD, test_long ? FIRST | MIDDLE | LAST : MIDDLE, BUILD, NEWTON, 50); }
static void on_a_list_of_solves(void) { table(CLOUD, FIRST | MIDDLE | LAST, NEWTON, CALLS, 50); }
static void with_corrected_weights(void) { table(CORRECTED, test_long ? FIRST | MIDDLE | LAST : MIDDLE, BUILD, NEWTON, 40); }
static void with_corrected_weights_of_solves(void) { table(CORRECTED, FIRST | MIDDLE | LAST, NEWTON, CALLS, 50); }

/* ---- what callbacks see, and where they may go ------------------------------------------------------------------------------- */

static double    seen[2 * 112];
static peri_body *clone;

static int32_t see_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)i, (void)j, (void)time, (void)stretch;
    MUST((peri_body *)user, peri_get_field((peri_body *)user, PERI_FIELD_VELOCITY, seen, 2 * 112));
    return 1;
}
/* peri.h: breaks are told after the step. So what on_break reads is what the run that it stops leaves. */
static void breaks_are_told_after_the_step(void) {
    double v[2 * 112];
    peri_body *b;
    no_trip();
    b = whole(COLUMNS);
    rate = 0.02;
    MUST(b, peri_on_break(b, see_break, b));
    CHECK(advance(b, PERI_INTEGRATOR_VELOCITY_VERLET, 43) == PERI_STOPPED);
    MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, v, 2 * 112));
    CHECK(v[100] != 0 && memcmp(v, seen, sizeof v) == 0);
    end(b);
}

static int32_t clone_and_leave(void *user, peri_body *b) {
    (void)user;
    CHECK(peri_body_clone(b, &clone, NULL) == PERI_OK);
    longjmp(trip.out, 1);
    return 0;
}
static void advance_to_frame(peri_body *b) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = 9;
    r.on_frame = clone_and_leave;
    if (setjmp(trip.out) == 0) MUST(b, peri_advance(b, &r));
}
/* peri.h: a clone is an independent copy. One made in a frame, at a whole step, runs on, whatever becomes of the run there. */
static void a_clone_of_a_frame_runs_on(void) {
    peri_body *b;
    no_trip();
    b = whole(COLUMNS);
    rate = 0.02;
    advance_to_frame(b);
    CHECK(advance(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1) == PERI_ERROR_ORDER);
    MUST(clone, advance(clone, PERI_INTEGRATOR_VELOCITY_VERLET, 1));
    CHECK(peri_step_count(clone) == 10 && peri_unlock(b) == PERI_OK && peri_step_count(b) == 9);
    peri_body_destroy(clone);
    end(b);
}

/* A matrix has no body to unlock: writing it takes no memory, so it may be left. */
static int32_t leave_writing(void *user, const void *from, int64_t count) {
    (void)user, (void)from, (void)count;
    longjmp(trip.out, 1);
    return 0;
}
static void write_matrix(const peri_matrix *m) {
    if (setjmp(trip.out) == 0) CHECK(peri_export_matrix_to(m, leave_writing, NULL) == PERI_OK);
}
static void a_matrix_is_left_as_it_was(void) {
    peri_matrix *m = NULL;
    peri_body *b;
    int64_t held;
    no_trip();
    b = whole(COLUMNS);
    MUST(b, peri_matrix_create(b, &m));
    held = bytes;
    write_matrix(m);
    CHECK(bytes == held && peri_export_matrix_to(m, write_bytes, NULL) == PERI_OK);
    peri_matrix_destroy(m);
    end(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(breaks_are_told_after_the_step);
    RUN(a_clone_of_a_frame_runs_on);
    RUN(a_matrix_is_left_as_it_was);
    RUN(first_calls);
    RUN(first_calls_of_newton);
    RUN(first_calls_of_other_solves);
    RUN(last_calls);
    LONG_RUN(last_calls_of_solves); /* first_calls_of_newton and _of_other_solves make the same calls */
    RUN(on_a_list);
    LONG_RUN(on_a_list_of_solves);
    RUN(with_corrected_weights);
    LONG_RUN(with_corrected_weights_of_solves);
    return test_end("test_callbacks");
}
