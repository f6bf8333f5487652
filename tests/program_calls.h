/* SPDX-License-Identifier: MIT */
/* program_calls.h - programs: calls of a body that is built. Most return the status of the one call that may change the body. */
#ifndef PROGRAM_CALLS_H
#define PROGRAM_CALLS_H

#include "program_make.h"

static int64_t one_call(program *p, int s); /* program_run.h */

static int64_t points_of(const slot *o) { return o->body && peri_family_width(o->body) > 0 ? peri_point_count(o->body) : 0; }

static double speed_of(const slot *o) { return sqrt(o->stress / (o->density > 0.0 ? o->density : 1.0)); }

static int32_t some_set(program *p, int s) { return some_id(p, s, PERI_KIND_SET); }

/* ---- sets --------------------------------------------------------------------------------------------------------- */

static const char *some_name(program *p) {
    static const char *const names[] = {NULL, "a", "b", "", NULL, "a rather long name of a set of points that is copied", NULL, NULL};
    return names[below(p, 8)];
}

static int64_t select_some(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = below(p, 4), count = 1 + below(p, 12);
    const char *name = some_name(p);
    double lo[3], hi[3];
    int k;
    place(p, o, lo);
    place(p, o, hi);
    for (k = 0; k < 3 && p->mood == 0; ++k)
        if (lo[k] > hi[k]) {
            const double x = lo[k];
            lo[k] = hi[k];
            hi[k] = x;
        }
    for (k = 0; k < count; ++k) p->ids[k] = some_point(p, points_of(o));
    if (kind == 0) return CALL(p, s, peri_select_box(o->body, name, GIVEN(0, lo), GIVEN(1, hi)));
    if (kind == 1) return CALL(p, s, peri_select_ball(o->body, name, GIVEN(0, lo), number(p, o->length, 4.0 * o->length)));
    if (kind == 2) {
        const int64_t status = CALL(p, s, peri_select_points(o->body, name, p->mood == MOOD_CHOICES && lo[0] > hi[0] ? 0 : count,
                                                             GIVEN(0, p->ids)));
        for (k = 0; k < count && status >= 0; ++k) HOLDS(p, p->ids[k] >= 0 && p->ids[k] < points_of(o));
        return status;
    }
    return CALL(p, s, peri_select_if(o->body, name, GIVEN(0, on_point), new_hook(p, s, 5)));
}

static int64_t select_points(program *p, int s) {
    const int64_t id = select_some(p, s);
    note_id(p, s, PERI_KIND_SET, id);
    return id;
}

static int64_t look_at_sets(program *p, int s) {
    peri_body *b = p->slots[s].body;
    const int32_t set = some_set(p, s), want = p->want;
    p->want = PERI_OK;
    const int32_t found = (int32_t)CALL(p, s, peri_find_set(b, GIVEN(0, "a")));
    p->want = want;
    const int64_t size = CALL(p, s, peri_size_of_set(b, set));
    if (found >= 0) HOLDS(p, found >> 27 == place_of(PERI_KIND_SET) && peri_size_of_set(b, found) > 0);
    p->want = want;
    const int64_t status = CALL(p, s, peri_get_set(b, set, GIVEN(0, p->ids), p->mood == MOOD_CHOICES ? number_of(p, 0, 4) : ROOM));
    int64_t k;
    for (k = 0; status == PERI_OK && k < size; ++k)
        HOLDS(p, p->ids[k] >= 0 && p->ids[k] < points_of(&p->slots[s]) && (k == 0 || p->ids[k] > p->ids[k - 1]));
    return status;
}

/* ---- cracks ------------------------------------------------------------------------------------------------------- */

/* Mostly one that the body can take; without a byte of its own. */
static int32_t some_standing(program *p, const slot *o) {
    if (p->mood == MOOD_CHOICES) return choice(p, PERI_CUT_INITIAL, 3);
    if (p->calls % 8 == 3) return PERI_CUT_INITIAL;
    return p->calls % 4 == 1 ? PERI_CUT_IN_PLACE : peri_step_count(o->body) > 0 ? PERI_CUT_NOW : PERI_CUT_INITIAL;
}

static int64_t cut(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = below(p, 8), turn = o->dim == 3 ? 3 : 0; /* mostly those of the space */
    const int64_t cut_before = peri_cut_count(o->body), broken_before = peri_broken_count(o->body);
    const int32_t standing = some_standing(p, o);
    int64_t status, k;
    double radius;
    for (k = 0; k < 4; ++k) place(p, o, &p->in[k * o->dim]);
    switch (kind < 6 ? turn + kind % 3 : kind == 6 ? 6 + below(p, 2) : below(p, 6)) {
    case 0: status = CALL(p, s, peri_cut_segment(o->body, standing, GIVEN(0, p->in), GIVEN(1, p->in + 2))); break;
    case 1: case 2:
        k = p->mood == MOOD_CHOICES ? below(p, 3) - 1 : 2 + kind % 3;
        status = CALL(p, s, peri_cut_polyline(o->body, standing, k, GIVEN(0, p->in)));
        break;
    case 3:
        radius = number(p, o->length, 4.0 * o->length);
        status = CALL(p, s, peri_cut_disc(o->body, standing, GIVEN(0, p->in), GIVEN(1, p->in + 3), radius));
        break;
    case 4: status = CALL(p, s, peri_cut_triangle(o->body, standing, GIVEN(0, p->in), GIVEN(1, p->in + 3), GIVEN(2, p->in + 6))); break;
    case 5: status = CALL(p, s, peri_cut_rectangle(o->body, standing, GIVEN(0, p->in), GIVEN(1, p->in + 3), GIVEN(2, p->in + 6))); break;
    case 6: status = CALL(p, s, peri_cut_if(o->body, standing, GIVEN(0, on_pair), new_hook(p, s, 5))); break;
    default:
        for (k = 0; k < 8; ++k) p->ids[k] = some_point(p, points_of(o));
        for (k = 1; k < 8 && draw(p) % 4; k += 2) p->ids[k] = p->ids[k - 1] > 0 ? p->ids[k - 1] - 1 : p->ids[k - 1] + 1;
        status = CALL(p, s, peri_cut_pairs(o->body, standing, p->mood == MOOD_CHOICES ? below(p, 3) - 1 : 4, GIVEN(0, p->ids)));
    }
    if (status >= 0 && !p->partial) {
        const int initial = standing == PERI_CUT_INITIAL;
        HOLDS(p, standing >= PERI_CUT_INITIAL && standing <= PERI_CUT_IN_PLACE && !(initial && peri_step_count(o->body) > 0));
        HOLDS(p, peri_cut_count(o->body) == cut_before + (initial ? status : 0));
        HOLDS(p, peri_broken_count(o->body) == broken_before + (initial ? 0 : status));
    }
    return status;
}

static int64_t set_no_fail(program *p, int s) {
    const int32_t set = some_set(p, s);
    return CALL(p, s, peri_set_no_fail(p->slots[s].body, set, draw(p) % 3 > 0));
}

static int64_t tell_breaks(program *p, int s) {
    hook *h = new_hook(p, s, 3);
    return CALL(p, s, peri_on_break(p->slots[s].body, h->kind == 2 ? NULL : on_break, h));
}

static int64_t look_at_bonds(program *p, int s) {
    slot *o = &p->slots[s];
    const int64_t points = points_of(o), width = o->body ? peri_family_width(o->body) : 0;
    const int64_t first = number_of(p, 0, points > 0 ? points : 1), count = number_of(p, 0, 3);
    const int64_t room = width > 0 && p->mood != MOOD_CHOICES ? ROOM : below(p, 64);
    const int64_t status = CALL(p, s, peri_get_families(o->body, first, count, GIVEN(0, p->ids), room));
    const int32_t i = some_point(p, points), j = some_point(p, points);
    (void)CALL(p, s, peri_bond_is_intact(o->body, i, j));
    return status;
}

/* ---- initial state, loads, obstacles ------------------------------------------------------------------------------ */

static int64_t add_motion(program *p, int s) {
    slot *o = &p->slots[s];
    const int32_t set = some_set(p, s);
    const int kind = draw(p) % 2;
    double v[3];
    vector(p, kind ? 0.25 * o->length : 0.1 * speed_of(o), v);
    const int64_t status = kind ? CALL(p, s, peri_add_displacement(o->body, set, GIVEN(0, v)))
                                : CALL(p, s, peri_add_velocity(o->body, set, GIVEN(1, v)));
    if (o->busy) HOLDS(p, status == PERI_ERROR_ORDER);
    return status;
}

static int64_t write_state(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = draw(p);
    const double size = (kind % 2 ? o->length : speed_of(o)) * (kind / 2 % 2 ? 0.01 : 0.2), step = 0.1 + below(p, 32);
    const int64_t n = points_of(o) * o->dim;
    const int32_t field = p->mood == MOOD_CHOICES ? choice(p, PERI_FIELD_POSITION, 17)
                        : kind % 2 ? PERI_FIELD_DISPLACEMENT : PERI_FIELD_VELOCITY;
    int64_t k;
    for (k = 0; k < n; ++k) p->in[k] = size * sin(step * (double)(k % 97) + (double)(k % o->dim));
    k = draw(p);
    if (p->mood == MOOD_NUMBERS && n > 0) p->in[k % n] = number(p, -size, size);
    const int64_t count = p->mood == MOOD_CHOICES && draw(p) % 2 ? below(p, 9) : n;
    const int64_t status = CALL(p, s, peri_set_field(o->body, field, GIVEN(0, p->in), count));
    if (o->busy && o->body && (field == PERI_FIELD_DISPLACEMENT || field == PERI_FIELD_VELOCITY)) /* fields of material may change */
        HOLDS(p, status == PERI_ERROR_ORDER);
    return status;
}

/* Or what is none: the bits alone, bits beyond those of axes, z in a plane. */
static int32_t some_axes(program *p, const slot *o) {
    const int32_t none = PERI_AXIS_X - 1;
    return p->mood == MOOD_CHOICES ? choice(p, draw(p) % 4 ? PERI_AXIS_X : 1, 9) : none | (1 + draw(p) % (o->dim == 3 ? 7 : 3));
}

static int64_t some_load(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = below(p, 8);
    const int32_t set = some_set(p, s), axes = some_axes(p, o);
    const double area = (o->dim == 3 ? o->length : 1.0) * number(p, o->length, 10.0 * o->length);
    const double pressure = o->stress * number(p, -0.02, 0.02);
    const int varies = draw(p) % 4 == 0;
    hook *h = varies ? new_hook(p, s, LOAD_KINDS) : NULL;
    peri_load_fn fn = varies ? on_load : NULL;
    double v[3], n[3];
    vector(p, kind < 2 ? 0.05 * o->length : kind < 3 ? 0.02 * speed_of(o) : kind < 4 ? 0.02 * o->stress / o->length : 0.02 * o->stress, v);
    vector(p, 1.0, n);
    if (varies && h->kind == LOAD_BURSTS) p->wild = 1;
    switch (kind) {
    case 0: case 1: return CALL(p, s, peri_prescribe_displacement(o->body, set, axes, draw(p) % 2 ? v : NULL, fn, h));
    case 2: return CALL(p, s, peri_prescribe_velocity(o->body, set, axes, draw(p) % 2 ? v : NULL, fn, h));
    case 3: return CALL(p, s, peri_apply_body_force(o->body, set, GIVEN(0, v), fn, h));
    case 4: return CALL(p, s, peri_apply_layer_traction(o->body, set, area, GIVEN(0, v), fn, h));
    case 5: return CALL(p, s, peri_apply_traction(o->body, set, area, GIVEN(0, n), GIVEN(1, v), fn, h));
    case 6: return CALL(p, s, peri_apply_pressure(o->body, set, pressure, fn, h));
    default: return CALL(p, s, peri_apply_bond_pressure_for_comparison(o->body, set, pressure, fn, h));
    }
}

/* Traction on a face of a box: the half of the body behind it feels it. */
static int64_t load_face(program *p, int s) {
    slot *o = &p->slots[s];
    const int axis = below(p, o->dim), side = draw(p) % 2;
    double lo[3], hi[3], n[3] = {0, 0, 0}, v[3], area = 1.0;
    int d;
    for (d = 0; d < 3; ++d) {
        lo[d] = o->lo[d];
        hi[d] = o->hi[d];
        if (d < o->dim && d != axis) area *= hi[d] - lo[d];
    }
    n[axis] = side ? 1.0 : -1.0;
    if (side) lo[axis] = 0.5 * (lo[axis] + hi[axis]);
    else hi[axis] = 0.5 * (lo[axis] + hi[axis]);
    vector(p, 0.02 * o->stress, v);
    p->partial = 1;
    const int64_t set = CALL(p, s, peri_select_box(o->body, NULL, lo, hi));
    note_id(p, s, PERI_KIND_SET, set);
    return set < 0 ? set : CALL(p, s, peri_apply_traction(o->body, (int32_t)set, area, n, v, NULL, NULL));
}

static int64_t add_load(program *p, int s) {
    const int64_t id = draw(p) % 8 ? some_load(p, s) : load_face(p, s);
    note_id(p, s, PERI_KIND_LOAD, id);
    return id;
}

static int64_t told_of_removal(program *p, int s, int32_t kind, int32_t id, int64_t status) {
    if (status == PERI_OK) p->slots[s].removed[place_of(kind)][PERI_ID_INDEX(id) % IDS_KNOWN] = 1;
    return status;
}

static int64_t remove_load(program *p, int s) {
    const int32_t id = some_id(p, s, PERI_KIND_LOAD);
    return told_of_removal(p, s, PERI_KIND_LOAD, id, CALL(p, s, peri_remove_load(p->slots[s].body, id)));
}

static int64_t some_obstacle(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = draw(p), moves = draw(p) % 3 == 0;
    const double stiffness = kind / 2 % 2 ? 0.0 : o->stress / (o->length * o->length) * number(p, 0.0, 2.0);
    hook *h = moves ? new_hook(p, s, MOVE_KINDS) : NULL;
    double x[3] = {0, 0, 0}, n[3] = {0, 0, 0};
    place(p, o, x);
    vector(p, 1.0, n);
    if (moves) h->size *= 0.1 * o->length;
    static const int32_t shapes[4] = {PERI_SHAPE_BALL, PERI_SHAPE_BALL, PERI_SHAPE_BOX, PERI_SHAPE_CAPSULE};
    peri_obstacle_desc d;
    peri_obstacle_desc_init(&d, kind % 2 ? PERI_SHAPE_PLANE : shapes[kind / 32 % 4]);
    memcpy(d.place, x, (size_t)o->dim * sizeof *x);
    for (int k = 0; k < o->dim; ++k) {
        d.normal[k] = d.axis[k] = n[k];
        d.size[k] = 3.0 * o->length;
    }
    d.length = 2.0 * o->length;
    d.radius = kind % 2 ? 0.0 : number(p, 0.5 * o->length, 3.0 * o->length);
    d.stiffness = stiffness;
    d.motion = moves ? on_motion : NULL;
    d.user = h;
    if (kind / 4 % 4 == 1) d.friction = 0.5;
    if (kind / 4 % 4 == 2) d.restitution = 0.5;
    if (kind / 4 % 4 == 3 && !moves) d.density = o->density; /* of a plane: refused */
    return CALL(p, s, peri_add_obstacle(o->body, GIVEN(0, &d)));
}

static int64_t add_obstacle(program *p, int s) {
    const int64_t id = some_obstacle(p, s);
    note_id(p, s, PERI_KIND_OBSTACLE, id);
    return id;
}

static int64_t remove_obstacle(program *p, int s) {
    const int32_t id = some_id(p, s, PERI_KIND_OBSTACLE);
    return told_of_removal(p, s, PERI_KIND_OBSTACLE, id, CALL(p, s, peri_remove_obstacle(p->slots[s].body, id)));
}

/* What was wild may be NaN; what was not is finite. */
static int64_t look_at_forces(program *p, int s) {
    slot *o = &p->slots[s];
    double force[3] = {0, 0, 0};
    const int of_load = draw(p) % 2;
    const int32_t id = some_id(p, s, of_load ? PERI_KIND_LOAD : PERI_KIND_OBSTACLE);
    const int64_t status = of_load ? CALL(p, s, peri_get_reaction(o->body, id, GIVEN(0, force)))
                                   : CALL(p, s, peri_get_obstacle_force(o->body, id, GIVEN(1, force), NULL));
    if (status == PERI_OK && !o->lost && !o->wild) HOLDS(p, finite_all(force, o->dim));
    return status;
}

/* ---- motion ------------------------------------------------------------------------------------------------------- */

/* A frame makes calls of its own. */
static int32_t on_frame(void *user, peri_body *b) {
    program *p = (program *)user;
    const int s = p->level > 0 ? p->running[p->level - 1] : 0, mood = p->mood, wild = p->wild, nulls = p->nulls;
    const int64_t fail_at = p->memory.fail_at;
    HOLDS(p, p->slots[s].body == b && p->slots[s].busy);
    if (p->level <= 2 && draw(p) % 2 == 0) (void)one_call(p, draw(p) % 4 ? s : 1 - s);
    p->mood = mood;
    p->wild = wild;
    p->nulls = nulls;
    p->memory.fail_at = fail_at;
    p->partial = 1;
    return --p->frames_left <= 0 || p->fault || draw(p) % 16 == 1;
}

static int64_t advance(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = draw(p), lasts = kind % 4 == 0, frames = kind / 4 % 2;
    const double stable = o->body ? peri_stable_step(o->body) : 1.0, start = peri_time(o->body);
    const int64_t before = peri_step_count(o->body);
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.integrator = choice(p, PERI_INTEGRATOR_VELOCITY_VERLET, 2);
    if (lasts) r.duration = stable * number(p, 0.5, 8.0);
    else r.steps = number_of(p, 1, 10);
    if (kind / 8 % 4 == 1) r.time_step = stable * number(p, 0.25, 1.25);
    if (kind / 8 % 4 == 2) r.safety = number(p, 0.125, 1.0);
    r.force_step = kind / 32 % 4 == 1;
    if (kind / 128) r.damping = number(p, 0.0, 0.5) / (stable > 0.0 ? stable : 1.0);
    if (frames) r.on_frame = on_frame;
    if (frames) r.frame_steps = number_of(p, 0, 4);
    if (p->mood == MOOD_NUMBERS || r.steps > 100) { /* no run may go on for ever */
        r.on_frame = on_frame;
        r.frame_steps = 1;
    }
    r.user = p;
    if (p->level == 0) p->frames_left = 10;
    if (p->nulls == 1) r.cookie = 0;
    const int64_t status = CALL(p, s, peri_advance(o->body, GIVEN(0, &r)));
    if (!o->body) return status;
    if (o->busy) HOLDS(p, status == PERI_ERROR_ORDER);
    if (status == PERI_ERROR_MEMORY || status == PERI_ERROR_CALLBACK || peri_step_count(o->body) > before || o->lost) p->partial = 1;
    if (status == PERI_OK && lasts) HOLDS(p, peri_time(o->body) == start + r.duration);
    if (status == PERI_OK && !lasts) HOLDS(p, peri_step_count(o->body) == before + r.steps);
    return status;
}

static int32_t on_iteration(void *user, int64_t iteration, double residual) {
    program *p = (program *)user;
    HOLDS(p, iteration > 0 && !(residual < 0.0));
    if (iteration == 2 && p->calls % 8 == 0) meddle(p);
    return --p->iterations_left <= 0;
}

static int64_t solve(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = draw(p), more = draw(p);
    peri_solve_desc t;
    peri_solve_report report;
    peri_solve_desc_init(&t);
    if (p->mood == MOOD_CHOICES) t.method = choice(p, PERI_METHOD_NEWTON, 3);
    else t.method = kind % 8 < 6 ? PERI_METHOD_NEWTON : kind % 8 == 6 ? PERI_METHOD_BICGSTAB : PERI_METHOD_RELAXATION;
    t.preconditioner = kind / 8 % 4 ? PERI_PRECONDITIONER_MULTILEVEL : choice(p, PERI_PRECONDITIONER_MULTILEVEL, 3);
    t.loose = p->mood == MOOD_CHOICES ? choice(p, PERI_LOOSE_REFUSED, 3) : PERI_LOOSE_REFUSED + kind / 32 % 4 % 3;
    t.fracture = kind / 128;
    t.criticality = more % 4 == 0 ? number(p, 0.0, 1.0) : 0.0;
    t.tolerance = more / 4 % 4 == 0 ? number(p, 0.0, 0.01) : 1e-3;
    if (more / 16 % 4 == 1) t.energy_tolerance = number(p, 0.0, 0.5);
    t.iterations = number_of(p, 20, 60);
    t.newton = number_of(p, 1, 5);
    t.breaks = number_of(p, 0, 3);
    t.steps = number_of(p, 1, 2);
    t.halvings = number_of(p, 0, 3);
    if (p->mood == MOOD_NUMBERS) t.load_from = number(p, 0.0, 1.0);
    if (p->mood == MOOD_NUMBERS) t.load_to = number(p, 0.0, 1.0);
    if (more / 64 == 1) {
        if (o->given[place_of(PERI_KIND_LOAD)] > 0 || p->mood == MOOD_CHOICES) t.curve_load = some_id(p, s, PERI_KIND_LOAD);
        t.curve = GIVEN(2, p->in);
        t.curve_rows = p->mood == MOOD_CHOICES ? below(p, 5) - 1 : t.curve_load == 0 ? 0 : 4;
        if (t.curve_load == 0) p->want = t.curve_rows > 0 ? PERI_ERROR_ID_NONE : PERI_OK; /* rows want a load */
    }
    t.on_iteration = on_iteration;
    if (more / 64 > 1 || t.steps > 10 || t.halvings > 10) t.on_step = on_frame;
    t.user = p;
    if (p->level == 0) p->frames_left = 6;
    p->iterations_left = 400;
    if (p->nulls == 1) t.cookie = 0;
    const int told_all = draw(p) % 4 > 0, wild = p->wild;
    const int64_t status = CALL(p, s, peri_solve(o->body, GIVEN(0, &t), told_all ? &report : NULL));
    if (o->busy && o->body) HOLDS(p, status == PERI_ERROR_ORDER);
    if (told_all && o->body && !o->wild) HOLDS(p, status != PERI_OK || finite_all(&report.residual, 1));
    /* how far it came is left to the solver; what is refused at once is not */
    if (status == PERI_ERROR_LOOSE && told_all && report.newton == 0 && report.iterations == 0 && report.broken == 0
        && report.steps == 0 && !p->partial)
        p->partial = PARTLY;
    else if (status != PERI_ERROR_ARGUMENT && status != PERI_ERROR_DESCRIPTOR && status != PERI_ERROR_ORDER && status != PERI_ERROR_LAW
             && status != PERI_ERROR_CHOICE && !(status <= PERI_ERROR_ID_NONE && status >= PERI_ERROR_ID_GONE))
        p->partial = 1;
    if (wild && p->partial) o->wild = 1; /* the body may stand at load_from now */
    return status;
}

static int64_t reset(program *p, int s) {
    slot *o = &p->slots[s];
    int64_t k, n = points_of(o) * o->dim;
    const int64_t status = CALL(p, s, peri_reset(o->body));
    if (o->busy && o->body) HOLDS(p, status == PERI_ERROR_ORDER);
    if (status < 0) return status;
    o->lost = 0;
    HOLDS(p, peri_time(o->body) == 0.0 && peri_step_count(o->body) == 0 && peri_broken_count(o->body) == 0);
    HOLDS(p, CALL(p, s, peri_get_field(o->body, PERI_FIELD_DISPLACEMENT, p->other, ROOM)) == PERI_OK);
    for (k = 0; k < n; ++k) HOLDS(p, p->other[k] == 0.0);
    HOLDS(p, CALL(p, s, peri_get_field(o->body, PERI_FIELD_DAMAGE_GROWN, p->other, ROOM)) == PERI_OK);
    for (k = 0; k < points_of(o); ++k) HOLDS(p, p->other[k] == 0.0);
    return status;
}

/* The body and a copy of it move alike, to the last bit. */
static int64_t twins(program *p, int s) {
    slot *o = &p->slots[s];
    const int kind = draw(p);
    peri_body *copy = NULL;
    peri_advance_desc r;
    peri_solve_desc t;
    peri_error e;
    if (o->busy || !o->body || p->mood == MOOD_MEMORY) return 0;
    int64_t status = peri_body_clone(o->body, &copy, NULL), other;
    if (!copy) return status;
    peri_advance_desc_init(&r);
    r.steps = 1 + kind % 4;
    r.integrator = PERI_INTEGRATOR_VELOCITY_VERLET + kind / 4 % 2;
    peri_solve_desc_init(&t);
    t.loose = PERI_LOOSE_BALANCED;
    t.iterations = 100;
    t.newton = 3;
    t.breaks = 1;
    t.halvings = 0;
    status = kind / 8 % 2 ? CALL(p, s, peri_advance(o->body, &r)) : CALL(p, s, peri_solve(o->body, &t, NULL));
    p->partial = 1;
    /* the copy stands in for the body, so that callbacks know which */
    peri_body *body = o->body;
    const peri_error record = o->record;
    print a = print_of(p, s, 1);
    const peri_error kept = o->record;
    o->body = copy;
    HOLDS(p, peri_get_error(copy, &o->record) == PERI_OK);
    other = kind / 8 % 2 ? CALL(p, s, peri_advance(o->body, &r)) : CALL(p, s, peri_solve(o->body, &t, NULL));
    HOLDS(p, peri_get_error(copy, &e) == PERI_OK);
    print b = print_of(p, s, 1);
    a.count[6] = b.count[6];
    if (status != other || (!o->lost && !same_print(a, b, PERI_OK))) blame(p, "a copy moves as the body does", __LINE__);
    if (status < 0) HOLDS(p, same_record(&e, &record));
    peri_body_destroy(copy);
    o->body = body;
    o->record = kept;
    return status;
}

/* ---- what can be read, written out, assembled --------------------------------------------------------------------- */

static int64_t look_at_fields(program *p, int s) {
    slot *o = &p->slots[s];
    const int32_t field = choice(p, PERI_FIELD_POSITION, 17);
    peri_view view;
    double linear[3], angular[3];
    peri_energy e;
    const int64_t room = p->mood == MOOD_CHOICES && draw(p) % 2 ? below(p, 100) : ROOM;
    const int32_t bond = p->mood == MOOD_CHOICES ? choice(p, PERI_BOND_POINT, 9) : PERI_BOND_POINT + below(p, 9);
    const int32_t points[3] = {0, below(p, 20) - (p->mood == MOOD_CHOICES), 1};
    const double places[6] = {0.1 * below(p, 12), 0.1 * below(p, 12), 0.1 * below(p, 4), 0.2, 0.1, 0.2};
    switch (below(p, 7)) {
    case 4: return CALL(p, s, peri_get_field_at(o->body, field, 3, GIVEN(0, points), GIVEN(1, p->other), room));
    case 5: return CALL(p, s, peri_interpolate_field(o->body, field, choice(p, 0, 2), 2, GIVEN(0, places), GIVEN(1, p->other), room));
    case 6: return CALL(p, s, peri_get_bonds(o->body, PERI_ALL, bond, GIVEN(0, p->other), room));
    case 0: return CALL(p, s, peri_get_field(o->body, field, GIVEN(0, p->other), room));
    case 1: return CALL(p, s, peri_view_field(o->body, field, GIVEN(0, &view)));
    case 2: return CALL(p, s, peri_get_energy(o->body, GIVEN(0, &e)));
    default: return CALL(p, s, peri_get_momentum(o->body, GIVEN(0, linear), GIVEN(1, angular)));
    }
}

static int64_t write_out(program *p, int s) {
    slot *o = &p->slots[s];
    hook *h = new_hook(p, s, 3);
    static const char *const paths[] = {"/dev/null", "", "no/such/folder/file"};
    const char *path = paths[below(p, 3)];
    switch (below(p, 8)) {
    case 0: case 1: return CALL(p, s, peri_export_vtu_to(o->body, GIVEN(0, on_write), h));
    case 2: case 3: return CALL(p, s, peri_export_history_to(o->body, choice(p, 0, 2), GIVEN(0, on_write), h));
    case 4: return CALL(p, s, peri_export_vtu(o->body, GIVEN(0, path)));
    case 5: return CALL(p, s, peri_export_history(o->body, GIVEN(0, path), 1));
    case 6: {
        const int32_t fields[2] = {choice(p, PERI_FIELD_POSITION, 24), PERI_FIELD_STRAIN};
        return CALL(p, s, peri_export_fields_to(o->body, GIVEN(0, fields), 2, GIVEN(1, on_write), h));
    }
    default: return 0;
    }
}

static int64_t look_at_constants(program *p, int s) {
    slot *o = &p->slots[s];
    double c = 1.0, s0 = 1.0, w0 = 1.0;
    const int kind = draw(p);
    if (kind % 4 == 0) {
        const int32_t id = some_id(p, s, PERI_KIND_MATERIAL);
        const int64_t status = CALL(p, s, peri_get_critical_energy(o->body, id, GIVEN(0, &w0)));
        if (status == PERI_OK && !o->wild) HOLDS(p, w0 > 0.0);
        return status;
    }
    const int32_t i = some_id(p, s, PERI_KIND_MATERIAL), j = some_id(p, s, PERI_KIND_MATERIAL);
    const int64_t status = CALL(p, s, peri_get_bond_constants(o->body, i, j, kind % 8 < 4 ? &c : NULL, GIVEN(0, &s0)));
    if (status == PERI_OK && !o->wild) HOLDS(p, c <= DBL_MAX && c > -DBL_MAX && !(s0 <= 0.0));
    return status;
}

static int64_t multiply(program *p, int s) {
    slot *o = &p->slots[s];
    const int64_t n = points_of(o) * o->dim;
    int64_t k;
    for (k = 0; k < n; ++k) p->in[k] = o->length * sin((double)k);
    k = draw(p);
    if (p->mood == MOOD_NUMBERS && n > 0) p->in[k % n] = number(p, -1.0, 1.0);
    const int64_t status = CALL(p, s, peri_multiply_stiffness(o->body, GIVEN(0, p->in), draw(p) % 2 ? GIVEN(1, p->out) : p->in,
                                                             p->mood == MOOD_CHOICES ? below(p, 9) : n));
    return status;
}

static void drop_matrix(program *p) {
    peri_matrix_destroy(p->matrix);
    p->matrix = NULL;
    p->matrix_bytes = 0;
}

/* The matrix lives on its own: it is read, written and freed whatever became of the body. */
static int64_t assemble(program *p, int s) {
    slot *o = &p->slots[s];
    hook *h = new_hook(p, s, 3);
    int64_t k, rows, entries, status = 0;
    if (draw(p) % 3 == 0) drop_matrix(p);
    if (!p->matrix) {
        const int64_t held = p->memory.bytes - total_of(o);
        status = CALL(p, s, peri_matrix_create(o->body, GIVEN(0, &p->matrix)));
        HOLDS(p, (status == PERI_OK) == (p->matrix != NULL));
        p->matrix_bytes = p->memory.bytes - total_of(o) - held;
        HOLDS(p, p->matrix || p->matrix_bytes == 0);
    }
    rows = peri_matrix_rows(p->matrix);
    entries = peri_matrix_entries(p->matrix);
    if (!p->matrix) {
        HOLDS(p, rows < 0 && entries < 0 && peri_get_matrix(NULL, NULL, NULL, NULL) == PERI_ERROR_ARGUMENT);
        return status;
    }
    HOLDS(p, rows >= 4 && entries >= rows && entries <= rows * rows);
    if (h->kind != 1) (void)peri_export_matrix_to(p->matrix, on_write, h);
    int64_t *start = (int64_t *)malloc((size_t)(rows + 1) * sizeof *start);
    int32_t *column = (int32_t *)malloc((size_t)entries * sizeof *column);
    double *value = (double *)malloc((size_t)entries * sizeof *value);
    HOLDS(p, peri_get_matrix(p->matrix, start, column, draw(p) % 2 ? value : NULL) == PERI_OK);
    HOLDS(p, start[0] == 0 && start[rows] == entries);
    for (k = 0; k < rows; ++k) {
        int64_t at;
        for (at = start[k]; at < start[k + 1]; ++at)
            HOLDS(p, column[at] >= 0 && column[at] < rows && (at == start[k] || column[at] > column[at - 1]));
    }
    free(start);
    free(column);
    free(value);
    return status;
}

#endif
