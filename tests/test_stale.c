/* SPDX-License-Identifier: MIT */
/* test_stale.c - what is derived from the state follows every change of it, and reading it changes nothing.

   Two sources of truth. (1) A body that nobody has read: what a body says after a change has the same bits whether or not it was read
   before, through a clone or not, from a frame or not. (2) A body built anew: of families without the bonds that are gone, with the
   displacement and velocity written into it; it has no past that it could forget to bring up to date. */
#include "scene.h"

#define NX    11
#define NY    7
#define ROOM  30000 /* numbers that a reader may give                                                                     */
#define CLOSE 1e-9  /* of the largest: sums over the same bonds in another order, times their number                      */

typedef struct kind {
    int32_t law, criterion, kernel, moving; /* moving: a load and an obstacle follow the time                           */
} kind;

/* ---- the scene ---------------------------------------------------------------------------------------------------- */

static int32_t swell(void *user, double time, int64_t count, const int32_t *points, double *values) {
    (void)user;
    for (int64_t k = 0; k < count; ++k) values[2 * k] = 1e-4 * (1 + time + points[k] % 3);
    return 0;
}

static int32_t creep(void *user, double time, double *place, double *turn) {
    (void)user, (void)turn;
    place[1] += 0.01 * time;
    return 0;
}

static peri_body *unbuilt(kind k) {
    const double lo[2] = {0, 0}, hi[2] = {NX, NY};
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRAIN;
    d.horizon = 2.6;
    d.kernel = k.kernel;
    d.number = 1; /* so that what calls return is the same of two bodies, ids included */
    d.threads = 1;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, k.law);
    m.young = m.density = 1;
    if (k.law != PERI_LAW_BOND_BASED) m.poisson = 0.2;
    m.criterion = k.criterion;
    if (k.criterion == PERI_CRITERION_STRETCH) m.critical_stretch = 0.2;
    else m.fracture_energy = 0.2;
    (void)MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &m)), lo, hi, 1.0));
    return b;
}

static int32_t columns(peri_body *b, double from, double to) {
    const double lo[2] = {from, -1}, hi[2] = {to, NY + 1};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

/* Sets 1 and 2, the ends; 3, the middle. Load 1, the support; 2, and 3 where `moving`, forces. Obstacle 1. */
static int32_t set_of(const peri_body *b, int64_t k) { return peri_id(b, PERI_KIND_SET, k); }

static void furnish(peri_body *b, kind k) {
    const double force[2] = {2e-4, 1e-4}, floor_[2] = {0, 0.6}, up[2] = {0, 1};
    (void)MUST(b, peri_build(b));
    CHECK(columns(b, 0, 3) == set_of(b, 1) && columns(b, NX - 3, NX) == set_of(b, 2) && columns(b, 4, 9) == set_of(b, 3));
    (void)MUST(b, peri_prescribe_displacement(b, set_of(b, 1), PERI_AXIS_X | PERI_AXIS_Y, NULL, NULL, NULL));
    (void)MUST(b, peri_apply_body_force(b, set_of(b, 2), force, NULL, NULL));
    if (k.moving) (void)MUST(b, peri_apply_body_force(b, set_of(b, 3), force, swell, NULL));
    (void)MUST(b, plane_obstacle(b, floor_, up, 0.0, k.moving ? creep : NULL, NULL));
}

static void stir(peri_body *b, int32_t field, double amplitude, uint64_t seed) {
    double *x = random_field(2 * NX * NY, amplitude, seed);
    put(b, field, x);
    free(x);
}

static int32_t march(peri_body *b, int64_t steps) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = steps;
    r.damping = 0.01;
    return peri_advance(b, &r);
}

static int32_t settle(peri_body *b) {
    peri_solve_desc s;
    peri_solve_desc_init(&s);
    s.tolerance = 1e-3;
    s.loose = PERI_LOOSE_BALANCED;
    s.criticality = 0; /* all at once, which takes the fewest rounds; and of those that find no equilibrium once is enough */
    s.halvings = 0;
    s.steps = 2;
    return peri_solve(b, &s, NULL);
}

/* What was done to a body before: nothing, steps, a solve, an initial crack and steps. */
enum { BUILT, MOVED, SOLVED, CRACKED, PASTS };

static peri_body *body_of(kind k, int past) {
    const double from[2] = {6, 0}, to[2] = {6, 3};
    peri_body *b = unbuilt(k);
    furnish(b, k);
    if (past == CRACKED) CHECK(MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to)) > 0);
    if (past == MOVED || past == CRACKED) {
        stir(b, PERI_FIELD_DISPLACEMENT, 0.02, 5);
        stir(b, PERI_FIELD_VELOCITY, 0.01, 6);
        (void)MUST(b, march(b, 4));
    }
    if (past == SOLVED) (void)MUST(b, settle(b));
    return b;
}

/* ---- changes ------------------------------------------------------------------------------------------------------ */

static int near_middle(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user;
    (void)i;
    (void)j;
    return xi[0] < 8 && xj[0] > 8 && xi[1] > 5;
}

static int32_t listen(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)user;
    (void)i;
    (void)j;
    (void)time;
    (void)stretch;
    return 0;
}

typedef enum change {
    NOTHING, ADD_DISPLACEMENT, ADD_VELOCITY, WRITE_DISPLACEMENT, WRITE_VELOCITY, RESET, MARCH, SOLVE, /* not from a frame */
    CUT_SEGMENT, CUT_LINE, CUT_PAIRS, CUT_IF, NO_FAIL, FAIL_AGAIN, LISTEN, HOLD, DRIVE, PUSH, PULL, FACE, PRESS, PRESS_CRACK,
    FREE_LOAD, FREE_SUPPORT, PLANE, BALL, FREE_OBSTACLE, CHANGES
} change;

static int64_t cut(peri_body *b, change what) {
    const double from[2] = {7, NY}, to[2] = {7, 4}, line[6] = {9, NY, 9, 5, 10, 5};
    const int32_t pairs[4] = {9, 10, 9 + NX, 10 + NX}, standing = peri_step_count(b) > 0 ? PERI_CUT_NOW : PERI_CUT_INITIAL;
    switch (what) {
    case CUT_SEGMENT: return peri_cut_segment(b, standing, from, to);
    case CUT_LINE: return peri_cut_polyline(b, standing, 3, line);
    case CUT_PAIRS: return peri_cut_pairs(b, standing, 2, pairs);
    default: return peri_cut_if(b, standing, near_middle, NULL);
    }
}

static int64_t load(peri_body *b, change what) {
    const double value[2] = {1e-4, -2e-4}, right[2] = {1, 0}, wall[2] = {NX - 0.6, 0}, left[2] = {-1, 0}, centre[2] = {6, NY + 0.8};
    switch (what) {
    case HOLD: return peri_prescribe_displacement(b, set_of(b, 2), PERI_AXIS_Y, value, NULL, NULL);
    case DRIVE: return peri_prescribe_velocity(b, set_of(b, 2), PERI_AXIS_X, value, NULL, NULL);
    case PUSH: return peri_apply_body_force(b, set_of(b, 3), value, NULL, NULL);
    case PULL: return peri_apply_layer_traction(b, set_of(b, 2), NY, value, NULL, NULL);
    case FACE: return peri_apply_traction(b, set_of(b, 2), NY, right, value, NULL, NULL);
    case PRESS: return peri_apply_pressure(b, PERI_ALL, 1e-4, NULL, NULL);
    case PRESS_CRACK: return peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1e-4, NULL, NULL);
    case FREE_LOAD: return peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 2));
    case FREE_SUPPORT: return peri_remove_load(b, peri_id(b, PERI_KIND_LOAD, 1));
    case PLANE: return plane_obstacle(b, wall, left, 0.0, NULL, NULL);
    case BALL: return ball_obstacle(b, centre, 1.7, 0.0, NULL, NULL);
    default: return peri_remove_obstacle(b, peri_id(b, PERI_KIND_OBSTACLE, 1));
    }
}

/* Returns what the call returns; only a load that needs a crack may fail. */
static int64_t apply(peri_body *b, change what) {
    const double by[2] = {0.02, 0.01};
    int64_t status = PERI_OK;
    switch (what) {
    case NOTHING: break;
    case ADD_DISPLACEMENT: status = peri_add_displacement(b, set_of(b, 3), by); break;
    case ADD_VELOCITY: status = peri_add_velocity(b, PERI_ALL, by); break;
    case WRITE_DISPLACEMENT: stir(b, PERI_FIELD_DISPLACEMENT, 0.03, 7); break;
    case WRITE_VELOCITY: stir(b, PERI_FIELD_VELOCITY, 0.03, 8); break;
    case RESET: status = peri_reset(b); break;
    case MARCH: status = march(b, 3); break;
    case SOLVE: status = settle(b); break;
    case CUT_SEGMENT: case CUT_LINE: case CUT_PAIRS: case CUT_IF: status = cut(b, what); break;
    case NO_FAIL: status = peri_set_no_fail(b, set_of(b, 3), 1); break;
    case FAIL_AGAIN: status = peri_set_no_fail(b, set_of(b, 3), 0); break;
    case LISTEN: status = peri_on_break(b, listen, NULL); break;
    default: status = load(b, what);
    }
    return what == PRESS_CRACK ? status : MUST(b, status);
}

/* ---- readers: each gives what it read, statuses included, and returns how many numbers ----------------------------- */

static int64_t read_field(peri_body *b, int32_t field, double *out) {
    const int64_t n = peri_size_of_field(b, field);
    out[0] = peri_get_field(b, field, out + 1, ROOM - 1);
    return 1 + n;
}

static int64_t view_force(peri_body *b, double *out) {
    peri_view v;
    out[0] = peri_view_field(b, PERI_FIELD_FORCE_DENSITY, &v);
    for (int64_t i = 0; i < v.count; ++i)
        for (int d = 0; d < 2; ++d)
            out[1 + 2 * i + d] = v.scale * ((const double *)v.data)[i * v.point_stride + d * v.component_stride];
    return 1 + 2 * v.count;
}

static int64_t read_totals(peri_body *b, double *out) {
    int64_t n = 0;
    for (int32_t k = 0; k < 4; ++k, n += 3) out[n] = peri_get_reaction(b, peri_id(b, PERI_KIND_LOAD, k + 1), out + n + 1);
    for (int32_t k = 0; k < 2; ++k, n += 3) out[n] = peri_get_obstacle_force(b, peri_id(b, PERI_KIND_OBSTACLE, k + 1), out + n + 1, NULL);
    return n;
}

static int64_t read_energy(peri_body *b, double *out) {
    peri_energy e;
    out[0] = peri_get_energy(b, &e);
    memcpy(out + 1, &e, sizeof e);
    return 1 + (int64_t)(sizeof e / sizeof(double));
}

static int64_t read_counts(peri_body *b, double *out) {
    out[0] = (double)peri_cut_count(b);
    out[1] = (double)peri_broken_count(b);
    out[2] = (double)peri_step_count(b);
    out[3] = peri_time(b);
    out[4] = peri_stable_step(b);
    return 5;
}

static int64_t multiply(peri_body *b, double *out) {
    double *in = random_field(2 * NX * NY, 1.0, 9);
    out[0] = peri_multiply_stiffness(b, in, out + 1, 2 * NX * NY);
    free(in);
    return 1 + 2 * NX * NY;
}

static int64_t assemble(peri_body *b, double *out) {
    peri_matrix *m = NULL;
    int64_t n = 0;
    out[0] = peri_matrix_create(b, &m);
    if (m) n = peri_matrix_entries(m);
    CHECK(n + 1 <= ROOM);
    if (m) (void)peri_get_matrix(m, NULL, NULL, out + 1);
    peri_matrix_destroy(m);
    return 1 + n;
}

static int64_t read_motion(peri_body *b, double *out) {
    int64_t n = read_field(b, PERI_FIELD_DISPLACEMENT, out);
    n += read_field(b, PERI_FIELD_VELOCITY, out + n);
    n += read_energy(b, out + n);
    return n + read_counts(b, out + n);
}

typedef enum reader {
    FORCE, VIEW, TOTALS, ENERGY, COUNTS, MULTIPLY, ASSEMBLE, STRESS, BOND_STRESS, SPREAD, REACTION, DAMAGE, GROWN,
    READERS,
    STEPS = READERS, EQUILIBRIUM, /* these move the body                                                                  */
    WAYS
} reader;

static int64_t look(peri_body *b, reader what, double *out) {
    switch (what) {
    case FORCE: return read_field(b, PERI_FIELD_FORCE_DENSITY, out);
    case VIEW: return view_force(b, out);
    case TOTALS: return read_totals(b, out);
    case ENERGY: return read_energy(b, out);
    case COUNTS: return read_counts(b, out);
    case MULTIPLY: return multiply(b, out);
    case ASSEMBLE: return assemble(b, out);
    case STRESS: return read_field(b, PERI_FIELD_STRESS, out);
    case BOND_STRESS: return read_field(b, PERI_FIELD_FORCE_STRESS, out);
    case SPREAD: return read_field(b, PERI_FIELD_ENERGY_DENSITY, out);
    case REACTION: return read_field(b, PERI_FIELD_REACTION, out);
    case DAMAGE: return read_field(b, PERI_FIELD_DAMAGE, out);
    case GROWN: return read_field(b, PERI_FIELD_DAMAGE_GROWN, out);
    case STEPS: out[0] = march(b, 3); return 1 + read_motion(b, out + 1);
    default: out[0] = settle(b); return 1 + read_motion(b, out + 1);
    }
}

static double here[ROOM], there[ROOM];

static void look_at_all(peri_body *b) {
    for (int r = 0; r < READERS; ++r) (void)look(b, (reader)r, here);
}

/* ---- (1) the same bits, read before or not -------------------------------------------------------------------------- */

static peri_body *copy_of(const peri_body *b) {
    peri_body *copy = NULL;
    (void)MUST(b, peri_body_clone(b, &copy, NULL));
    return copy;
}

/* Does `b` say what `other` says? Both may move. */
static void compare(peri_body *b, peri_body *other, reader r, int past, int what, const char *who) {
    const int64_t n = look(b, r, here), m = look(other, r, there);
    const int same = n == m && memcmp(here, there, (size_t)n * sizeof *here) == 0;
    CHECK(same);
    if (!same && test_bad <= 10) printf("    %s: past %d, change %d, reader %d\n", who, past, what, (int)r);
}

/* `read` was read before the change: it and a clone of it against bodies that nobody read. */
static void compare_all(peri_body *read, const peri_body *unread, int past, int what) {
    for (int r = 0; r < WAYS; ++r) {
        if (r == ASSEMBLE) continue; /* below: it takes longest, and needs no more of a clone than MULTIPLY */
        peri_body *clone = copy_of(read), *other = copy_of(unread);
        compare(clone, other, (reader)r, past, what, "clone");
        peri_body_destroy(clone);
        peri_body_destroy(other);
    }
    for (int r = 0; r < READERS; ++r) {
        peri_body *other = copy_of(unread);
        compare(read, other, (reader)r, past, what, "read before");
        peri_body_destroy(other);
    }
}

/* A quarter of the pasts of every change in the usual run: the others in other scenes. All with --long. */
static int is_spared(kind k, int past, int what) { return !test_long && (past + what + k.law + k.kernel) % 4; }

static void same_bits(kind k) {
    for (int past = 0; past < PASTS; ++past) {
        peri_body *built = body_of(k, past), *read = body_of(k, past);
        look_at_all(read);
        for (int what = 0; what < CHANGES; ++what) {
            if (is_spared(k, past, what)) continue;
            peri_body *b = copy_of(read), *unread = copy_of(built);
            CHECK(apply(b, (change)what) == apply(unread, (change)what));
            compare_all(b, unread, past, what);
            peri_body_destroy(b);
            peri_body_destroy(unread);
        }
        peri_body_destroy(built);
        peri_body_destroy(read);
    }
}

static const kind kinds[] = {
    {PERI_LAW_BOND_BASED, PERI_CRITERION_STRETCH, PERI_KERNEL_BEST, 1},
    {PERI_LAW_BOND_BASED, PERI_CRITERION_STRETCH, PERI_KERNEL_LIST, 1},
    {PERI_LAW_LPS, PERI_CRITERION_STRETCH, PERI_KERNEL_BEST, 1},
    {PERI_LAW_LPS, PERI_CRITERION_BOND_ENERGY, PERI_KERNEL_REFERENCE, 1},
    {PERI_LAW_OTERKUS, PERI_CRITERION_NODE_ENERGY, PERI_KERNEL_BEST, 1},
    {PERI_LAW_CORRESPONDENCE, PERI_CRITERION_STRETCH, PERI_KERNEL_BEST, 1},
    {PERI_LAW_CORRESPONDENCE, PERI_CRITERION_STRETCH, PERI_KERNEL_LIST, 1},
};
#define KINDS (sizeof kinds / sizeof *kinds)

static void reading_before_a_change_leaves_no_trace(void) {
    for (size_t k = 0; k < KINDS; ++k) same_bits(kinds[k]);
}

/* The case above takes clones for fresh bodies. Here a body that was built and changed is the truth for clones taken before and after. */
static void clones_are_bodies(void) {
    for (size_t k = 0; k < KINDS; ++k)
        for (int what = 0; what < CHANGES; ++what)
            for (int r = 0; r < WAYS; r += 3) {
                if (!test_long && (k + (size_t)what + (size_t)r / 3) % 3) continue;
                peri_body *fresh = body_of(kinds[k], MOVED), *first = body_of(kinds[k], MOVED);
                peri_body *early = copy_of(first), *late;
                (void)apply(first, (change)what);
                late = copy_of(first);
                peri_body_destroy(first);
                (void)apply(fresh, (change)what);
                (void)apply(early, (change)what);
                compare(early, fresh, (reader)r, MOVED, what, "cloned before");
                peri_body_destroy(fresh);
                fresh = body_of(kinds[k], MOVED);
                (void)apply(fresh, (change)what);
                compare(late, fresh, (reader)r, MOVED, what, "cloned after");
                peri_body_destroy(fresh);
                peri_body_destroy(early);
                peri_body_destroy(late);
            }
}

/* ---- from frames -------------------------------------------------------------------------------------------------- */

typedef struct visit {
    int what, reads, calls;
} visit;

static int32_t change_in_frame(void *user, peri_body *b) {
    visit *v = (visit *)user;
    if (v->calls++ > 0) return 0;
    if (v->reads) look_at_all(b);
    (void)apply(b, (change)v->what);
    if (v->reads) look_at_all(b);
    return 0;
}

static int32_t run_with(peri_body *b, visit *v, int statics) {
    peri_advance_desc r;
    peri_solve_desc s;
    peri_advance_desc_init(&r);
    peri_solve_desc_init(&s);
    r.steps = 4;
    r.frame_steps = 2;
    r.on_frame = s.on_step = change_in_frame;
    r.user = s.user = v;
    s.tolerance = 1e-3;
    s.loose = PERI_LOOSE_BALANCED;
    s.criticality = 0; /* all at once, which takes the fewest rounds; and of those that find no equilibrium once is enough */
    s.halvings = 0;
    s.steps = 2;
    return statics ? peri_solve(b, &s, NULL) : peri_advance(b, &r);
}

static void frames(kind k, int statics) {
    peri_body *built = body_of(k, MOVED);
    for (int what = CUT_SEGMENT; what < CHANGES; ++what) {
        if (is_spared(k, statics, what)) continue;
        peri_body *b = copy_of(built), *unread = copy_of(built);
        visit looks = {what, 1, 0}, passes = {what, 0, 0};
        CHECK(run_with(b, &looks, statics) == run_with(unread, &passes, statics));
        CHECK(looks.calls == passes.calls);
        compare_all(b, unread, MOVED, what);
        peri_body_destroy(b);
        peri_body_destroy(unread);
    }
    peri_body_destroy(built);
}

static void reading_in_on_frame_leaves_no_trace(void) {
    for (size_t k = 0; k < KINDS; ++k) frames(kinds[k], 0);
}

static void reading_in_on_step_leaves_no_trace(void) {
    for (size_t k = 0; k < KINDS; ++k) frames(kinds[k], 1);
}

/* ---- (2) a body built anew ------------------------------------------------------------------------------------------ */

/* The families of b without the bonds that are gone, the motion of b, the loads of the scene and those of the change. */
static peri_body *anew(peri_body *b, kind k, change what) {
    const int64_t n = peri_point_count(b), width = peri_family_width(b);
    int32_t *rows = (int32_t *)calloc((size_t)(n * width), sizeof *rows);
    double *u = get(b, PERI_FIELD_DISPLACEMENT), *v = get(b, PERI_FIELD_VELOCITY);
    peri_body *fresh = unbuilt(k);
    (void)MUST(b, peri_get_families(b, 0, n, rows, n * width));
    for (int32_t i = 0; i < n; ++i)
        for (int64_t e = i * width; e < (i + 1) * width; ++e)
            if (rows[e] != i && peri_bond_is_intact(b, i, rows[e]) == 0) rows[e] = i;
    (void)MUST(fresh, peri_set_families(fresh, (int32_t)width, rows));
    furnish(fresh, k);
    if (what >= HOLD) (void)apply(fresh, what);
    put(fresh, PERI_FIELD_DISPLACEMENT, u);
    put(fresh, PERI_FIELD_VELOCITY, v);
    free(rows);
    free(u);
    free(v);
    return fresh;
}

static void near_to(peri_body *b, peri_body *fresh, reader r, int past, int what) {
    double most = 0, off = 0;
    const int64_t n = look(b, r, here);
    CHECK(look(fresh, r, there) == n);
    for (int64_t k = 0; k < n; ++k) {
        most = fmax(most, fabs(there[k]));
        off = fmax(off, fabs(here[k] - there[k]));
    }
    CHECK_NEAR(off, 0, 0, CLOSE * most);
    if (off > CLOSE * most) printf("    past %d, change %d, reader %d\n", past, what, (int)r);
}

/* Changes that leave the force as it is, or that see cut bonds, are not compared: a step leaves other numbers at supports. */
static int is_plain(int what) {
    return what != NOTHING && what != MARCH && !(what >= NO_FAIL && what <= LISTEN) && what != PRESS_CRACK;
}

static void as_built(kind k) {
    static const reader readers[] = {FORCE, VIEW, MULTIPLY, ASSEMBLE, STRESS, BOND_STRESS, SPREAD};
    k.moving = 0;
    for (int past = 0; past < PASTS; ++past)
        for (int what = 0; what < CHANGES; ++what) {
            if (!is_plain(what) || (past == CRACKED && (what == FACE || what == PRESS)) || is_spared(k, past, what)) continue;
            peri_body *b = body_of(k, past), *fresh;
            look_at_all(b);
            (void)apply(b, (change)what);
            fresh = anew(b, k, (change)what);
            for (size_t r = 0; r < sizeof readers / sizeof *readers; ++r) {
                if (readers[r] == ASSEMBLE && peri_broken_count(b) + peri_cut_count(b) > 0) continue; /* other pairs couple */
                near_to(b, fresh, readers[r], past, what);
            }
            peri_body_destroy(b);
            peri_body_destroy(fresh);
        }
}

static void changes_are_as_built_anew(void) {
    for (size_t k = 0; k < KINDS; ++k) as_built(kinds[k]);
}

/* A body that was reset is one that was built, cut and furnished, and nothing else. */
static void reset_is_as_built(void) {
    for (size_t k = 0; k < KINDS; ++k)
        for (int what = 0; what < NO_FAIL; ++what) {
            peri_body *b = body_of(kinds[k], MOVED), *fresh = body_of(kinds[k], BUILT);
            (void)apply(b, (change)what);
            look_at_all(b);
            (void)MUST(b, peri_reset(b));
            compare_all(b, fresh, BUILT, what);
            peri_body_destroy(b);
            peri_body_destroy(fresh);
        }
}

/* ---- the ledger --------------------------------------------------------------------------------------------------- */

static peri_energy ledger_of(peri_body *b) {
    peri_energy e;
    memset(&e, 0, sizeof e);
    (void)MUST(b, peri_get_energy(b, &e));
    return e;
}

/* SOURCE OF TRUTH: the first law. What the caller puts in or cuts out at one moment is all of the change in energy: it counts as
   `initial`, and the error, left by the time step, stays what it was. */
static void changes_by_the_caller_are_initial(void) {
    static const change changes[] = {ADD_DISPLACEMENT, ADD_VELOCITY, WRITE_DISPLACEMENT, WRITE_VELOCITY,
                                     CUT_SEGMENT,      CUT_LINE,     CUT_PAIRS,          CUT_IF};
    for (size_t k = 0; k < KINDS; ++k)
        for (int past = 0; past < PASTS; ++past)
            for (size_t c = 0; c < sizeof changes / sizeof *changes; ++c) {
                peri_body *b = body_of(kinds[k], past);
                const peri_energy before = ledger_of(b);
                (void)apply(b, changes[c]);
                const peri_energy after = ledger_of(b);
                const double put_in = after.kinetic + after.elastic - before.kinetic - before.elastic;
                CHECK_NEAR(after.initial - before.initial, put_in, 1e-9, 1e-14);
                CHECK_NEAR(after.error, before.error, 1e-9, 1e-14);
                CHECK(past == BUILT ? changes[c] >= CUT_SEGMENT || put_in > 0 : put_in != 0);
                peri_body_destroy(b);
            }
}

/* The same of several changes with nothing read between them: they count together. */
static void changes_add_up_as_initial(void) {
    static const change changes[] = {ADD_VELOCITY, ADD_DISPLACEMENT, CUT_SEGMENT, WRITE_VELOCITY, CUT_IF, ADD_VELOCITY};
    for (int past = 0; past < PASTS; ++past)
        for (size_t c = 0; c + 2 < sizeof changes / sizeof *changes; ++c) {
            peri_body *b = body_of(kinds[0], past);
            const peri_energy before = ledger_of(b);
            for (size_t k = c; k < c + 3; ++k) (void)apply(b, changes[k]);
            const peri_energy after = ledger_of(b);
            const double put_in = after.kinetic + after.elastic - before.kinetic - before.elastic;
            CHECK_NEAR(after.initial - before.initial, put_in, 1e-9, 1e-14);
            CHECK_NEAR(after.error, before.error, 1e-9, 1e-14);
            peri_body_destroy(b);
        }
}

/* SOURCE OF TRUTH: what each scene is here for. */
static void scenes_are_stored_as_meant(void) {
    static const char *const text[KINDS] = {"columns", "list", "columns", "reference", "columns", "columns", "list"};
    for (size_t k = 0; k < KINDS; ++k) {
        peri_body *b = body_of(kinds[k], BUILT);
        CHECK(strstr(peri_kernel_text(b), text[k]) != NULL);
        if (!strstr(peri_kernel_text(b), text[k])) printf("    %s\n", peri_kernel_text(b));
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(scenes_are_stored_as_meant);
    RUN(reading_before_a_change_leaves_no_trace);
    RUN(clones_are_bodies);
    RUN(reading_in_on_frame_leaves_no_trace);
    RUN(reading_in_on_step_leaves_no_trace);
    RUN(changes_are_as_built_anew);
    RUN(reset_is_as_built);
    RUN(changes_by_the_caller_are_initial);
    RUN(changes_add_up_as_initial);
    return test_end("test_stale");
}
