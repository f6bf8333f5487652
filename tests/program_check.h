/* SPDX-License-Identifier: MIT */
/* program_check.h - what must hold after every call of a program. */
#ifndef PROGRAM_CHECK_H
#define PROGRAM_CHECK_H

#include "program.h"

/* ---- calls -------------------------------------------------------------------------------------------------------- */

static void enter(program *p, int s, const char *text) {
    if (p->trace) printf("    %2d%*s slot %d: %s\n", p->calls, 2 * p->level, "", s, text);
    p->running[p->level] = s;
    p->refused[p->level] = p->memory.refused;
    p->wants[p->level] = p->want;
    p->want = PERI_OK;
    p->names[p->level] = text;
    p->level++;
    p->slots[s].busy++;
}

static int same_record(const peri_error *a, const peri_error *b) {
    return a->code == b->code && a->index == b->index && a->reserved == b->reserved && a->field == b->field && a->text == b->text
        && memcmp(&a->value, &b->value, sizeof a->value) == 0;
}

/* The index of a record: a point where it names one. */
static int names_a_point(const slot *s, const peri_error *e) {
    const int64_t points = peri_point_count(s->body);
    switch (e->code) {
    case PERI_ERROR_UNSTABLE: /* or a free obstacle */
        if (strcmp(e->field, "obstacle") != 0) return e->index >= 0 && e->index < points;
        return e->index == peri_id((peri_body *)s->body, PERI_KIND_OBSTACLE, PERI_ID_INDEX((int32_t)e->index));
    case PERI_ERROR_COINCIDENT: return e->index >= 0 && e->index < points;
    case PERI_ERROR_LOOSE: return e->index >= 0 && e->index < points;
    case PERI_ERROR_CALLBACK: return strcmp(e->field, "value") != 0 || (e->index >= 0 && e->index < points);
    default: return 1;
    }
}

static void check_text(program *p, const peri_error *e) {
    char text[256];
    int64_t length = peri_format_error(e, text, sizeof text);
    HOLDS(p, length > 0 && (length >= (int64_t)sizeof text || (int64_t)strlen(text) == length));
    HOLDS(p, peri_format_error(e, NULL, 0) == length && strncmp(text, e->text, strlen(e->text) < 100 ? strlen(e->text) : 100) == 0);
}

/* A wrong id is told by its own status, where nothing else is wrong that is looked at before: it is too early, or another choice, flag,
   count or number is wrong, too. And no other call is refused for its ids. */
static int ends_by_its_ids(const program *p, int64_t status, int32_t want) {
    if (status <= PERI_ERROR_ID_NONE && status >= PERI_ERROR_ID_GONE) return status == want;
    if (p->mood == MOOD_NUMBERS && status == PERI_ERROR_RANGE) return 1;
    return want == PERI_OK || status == PERI_ERROR_ORDER || status == PERI_ERROR_CHOICE || status == PERI_ERROR_ARGUMENT
        || status == PERI_ERROR_DESCRIPTOR;
}

static int64_t told(program *p, int s, int64_t status, int line) {
    slot *o = &p->slots[s];
    peri_error e;
    if (p->trace && status < 0) printf("    %2d%*s %s\n", p->calls, 2 * p->level, "", peri_status_text((int32_t)status));
    o->busy--;
    p->level--;
#ifdef PROGRAM_TOLD /* of a test that looks on: the call as text, and its status */
    PROGRAM_TOLD(p->names[p->level], status);
#endif
    if (!o->body) {
        if (status != PERI_ERROR_ARGUMENT) blame(p, "a call without a body is refused as an argument", line);
        return status;
    }
    HOLDS(p, peri_get_error(o->body, &e) == PERI_OK);
    if (!ends_by_its_ids(p, status, p->wants[p->level])) blame(p, "a wrong id is told by the status that says why", line);
    if (status < 0) {
        const int32_t code = (int32_t)status;
        if (status <= PERI_ERROR_LEFT_OUT) blame(p, "the status is listed", line);
        if (e.code != code || e.reserved != 0 || !e.field || e.text != peri_status_text(code))
            blame(p, "the record is of this refusal", line);
        if (!names_a_point(o, &e)) blame(p, "the record names a point", line);
        if (code == PERI_ERROR_MEMORY && p->memory.refused == p->refused[p->level]) blame(p, "the allocator has refused", line);
        if (code == PERI_ERROR_UNSTABLE) o->lost = 1;
        /* a callback that fails within a step ends it before it is known to be unstable */
        if (code == PERI_ERROR_CALLBACK && o->wild && strncmp(p->names[p->level], "peri_advance", 12) == 0) o->lost = 1;
        check_text(p, &e);
        o->record = e;
    } else {
        if (!same_record(&e, &o->record)) blame(p, "a call that succeeds leaves the record of the last failure", line);
        if (p->wild) o->wild = 1;
    }
    return status;
}

/* ---- what can be seen of a body ----------------------------------------------------------------------------------- */

typedef struct print { /* of a body, to tell whether a call has changed it                                                */
    int64_t  count[9];
    double   time, step;
    uint64_t state, deep;
} print;

static uint64_t hash(uint64_t h, const void *data, size_t bytes) {
    const unsigned char *c = (const unsigned char *)data;
    size_t k;
    for (k = 0; k + 8 <= bytes; k += 8) {
        uint64_t word;
        memcpy(&word, c + k, 8);
        h = (h ^ word) * UINT64_C(0x9E3779B97F4A7C15);
        h ^= h >> 29;
    }
    return h;
}

static int64_t total_of(const slot *s) {
    peri_memory m;
    return s->body && peri_get_memory(s->body, &m) == PERI_OK ? m.total : 0;
}

static int finite_all(const double *x, int64_t n) {
    int64_t k;
    for (k = 0; k < n; ++k)
        if (!(fabs(x[k]) <= DBL_MAX)) return 0;
    return 1;
}

/* deep: energies and damage, too, which takes longer. */
static print print_of(program *p, int s, int deep) {
    const slot *o = &p->slots[s];
    print r;
    int32_t field, kind;
    memset(&r, 0, sizeof r);
    if (!o->body) return r;
    r.count[0] = peri_point_count(o->body);
    r.count[1] = peri_family_width(o->body);
    r.count[2] = peri_entry_count(o->body);
    r.count[3] = peri_cut_count(o->body);
    r.count[4] = peri_broken_count(o->body);
    r.count[5] = peri_step_count(o->body);
    r.count[6] = total_of(o);
    r.time = peri_time(o->body);
    if (r.count[2] == 0) return r;
    for (kind = PERI_KIND_MATERIAL; kind <= PERI_KIND_OBSTACLE; ++kind) { /* as many as were given, and no more */
        const int32_t count = o->given[place_of(kind)];
        if (count > 0) HOLDS(p, peri_id(o->body, kind, count) > 0);
        p->want = PERI_ERROR_ID_GONE;
        HOLDS(p, CALL(p, s, peri_id(p->slots[s].body, kind, count + 1)) == PERI_ERROR_ID_GONE);
        r.count[7] = 31 * r.count[7] + count;
    }
    for (field = PERI_FIELD_DISPLACEMENT; field <= PERI_FIELD_VELOCITY; ++field) {
        const int64_t n = peri_size_of_field(o->body, field);
        HOLDS(p, CALL(p, s, peri_get_field(p->slots[s].body, field, p->other, ROOM)) == PERI_OK);
        r.state = hash(r.state, p->other, (size_t)n * sizeof(double));
        if (!o->lost && !finite_all(p->other, n)) blame(p, "motion is finite where no instability was reported", __LINE__);
    }
    if (deep && !o->lost) {
        peri_energy e;
        HOLDS(p, CALL(p, s, peri_get_energy(p->slots[s].body, &e)) == PERI_OK);
        r.deep = hash(0, &e, sizeof e);
        HOLDS(p, CALL(p, s, peri_get_field(p->slots[s].body, PERI_FIELD_DAMAGE, p->other, ROOM)) == PERI_OK);
        r.deep = hash(r.deep, p->other, (size_t)r.count[0] * sizeof(double));
        r.step = peri_stable_step(o->body);
    }
    return r;
}

/* Memory that was taken before more of it was refused may stay. */
static int same_print(print a, print b, int32_t status) {
    if (status == PERI_ERROR_MEMORY) a.count[6] = b.count[6];
    return memcmp(a.count, b.count, sizeof a.count) == 0 && a.state == b.state && a.deep == b.deep
        && memcmp(&a.time, &b.time, sizeof a.time) == 0 && memcmp(&a.step, &b.step, sizeof a.step) == 0;
}

/* What the allocator counts is what the bodies say, those that share their points counted once. */
static void check_memory(program *p) {
    int64_t said = p->matrix_bytes;
    peri_memory m;
    int s;
    for (s = 0; s < SLOTS; ++s) {
        const slot *o = &p->slots[s];
        if (o->busy) return; /* solvers hold some of their own */
        if (!o->body) continue;
        HOLDS(p, peri_get_memory(o->body, &m) == PERI_OK);
        HOLDS(p, m.points >= 0 && m.families >= 0 && m.damage >= 0 && m.state >= 0 && m.laws > 0 && m.loads >= 0 && m.fields >= 0);
        HOLDS(p, m.total == m.points + m.families + m.damage + m.state + m.laws + m.loads + m.fields);
        HOLDS(p, m.shared >= 0 && m.shared < m.total);
        said += m.total;
    }
    if (p->slots[0].body && p->slots[1].body && p->slots[0].family == p->slots[1].family) said -= m.shared;
    HOLDS(p, said == p->memory.bytes);
    HOLDS(p, p->memory.wrong == 0);
}

static void check_field(program *p, int s, int32_t field) {
    const slot *o = &p->slots[s];
    const int64_t n = peri_size_of_field(o->body, field);
    const int64_t status = CALL(p, s, peri_get_field(p->slots[s].body, field, p->other, ROOM));
    peri_view view;
    int64_t i, c = 0;
    int d;
    if (status == PERI_ERROR_CALLBACK || (status == PERI_ERROR_RANGE && o->wild)) return; /* loads beyond the precision */
    HOLDS(p, status == PERI_OK && n > 0 && n <= ROOM);
    if (p->fault) return;
    if (!o->lost && !o->wild && !finite_all(p->other, n)) blame(p, "a field is finite where only ordinary numbers went in", __LINE__);
    for (i = 0; i < n && (field == PERI_FIELD_DAMAGE || field == PERI_FIELD_DAMAGE_GROWN); ++i)
        HOLDS(p, p->other[i] >= 0.0 && p->other[i] <= 1.0);
    for (i = 0; i < n && field == PERI_FIELD_MATERIAL; ++i)
        HOLDS(p, p->other[i] >= 1.0 && p->other[i] <= o->given[place_of(PERI_KIND_MATERIAL)]);
    if (field > PERI_FIELD_VOLUME || CALL(p, s, peri_view_field(p->slots[s].body, field, &view)) < 0) return;
    for (i = 0; i < view.count; ++i)
        for (d = 0; d < view.components; ++d, ++c) {
            const int64_t at = i * view.point_stride + d * view.component_stride;
            const double raw = view.type == PERI_TYPE_F32 ? (double)((const float *)view.data)[at] : ((const double *)view.data)[at];
            const double x = view.offset[d] + view.scale * raw;
            if (!(p->other[c] == x || (x != x && p->other[c] != p->other[c]))) blame(p, "a view shows what is read", __LINE__);
        }
}

/* Called after every call, whatever became of it. */
static void check_body(program *p, int s) {
    const slot *o = &p->slots[s];
    const peri_body *b = o->body;
    int64_t bonds, cut, broken;
    double step;
    if (!b) return;
    bonds = peri_entry_count(b);
    cut = peri_cut_count(b);
    broken = peri_broken_count(b);
    step = peri_stable_step(b);
    HOLDS(p, peri_dimension(b) == o->dim && peri_kernel_text(b));
    HOLDS(p, cut >= 0 && broken >= 0 && cut + broken <= bonds / 2 && bonds % 2 == 0);
    HOLDS(p, peri_step_count(b) >= 0 && peri_time(b) >= 0.0 && (o->lost || peri_time(b) <= DBL_MAX));
    if (bonds == 0) {
        HOLDS(p, peri_family_width(b) == 0 && step == 0.0 && !peri_kernel_text(b)[0]);
        return;
    }
    HOLDS(p, peri_family_width(b) > 0 && peri_family_width(b) < peri_point_count(b) && peri_kernel_text(b)[0]);
    HOLDS(p, step >= 0.0 && step <= DBL_MAX && (o->wild || step > 0.0));
    check_field(p, s, PERI_FIELD_POSITION + p->calls % 16);
    if (p->calls % 4 == 0 && !o->lost) {
        peri_energy e;
        double linear[3], angular[3];
        HOLDS(p, CALL(p, s, peri_get_energy(p->slots[s].body, &e)) == PERI_OK);
        HOLDS(p, CALL(p, s, peri_get_momentum(p->slots[s].body, linear, angular)) == PERI_OK);
        if (!o->wild) {
            HOLDS(p, finite_all(&e.kinetic, 1) && finite_all(&e.elastic, 1) && finite_all(&e.external, 1) && finite_all(&e.obstacle, 1));
            HOLDS(p, finite_all(&e.damping, 1) && finite_all(&e.fracture, 1) && finite_all(&e.initial, 1) && finite_all(&e.error, 1));
            HOLDS(p, finite_all(linear, o->dim) && finite_all(angular, o->dim == 2 ? 1 : 3));
            HOLDS(p, e.kinetic >= 0.0);
        }
    }
}

/* Families are mutual, in order, and the bonds that carry force are those that are neither cut nor broken. Slow. */
static void check_families(program *p, int s) {
    peri_body *b = p->slots[s].body;
    const int64_t points = peri_point_count(b), width = peri_family_width(b);
    int64_t i, k, live = 0, bonds = 0;
    for (i = 0; i < points && width > 0 && width <= ROOM; ++i) {
        HOLDS(p, CALL(p, s, peri_get_families(b, i, 1, p->ids, ROOM)) == PERI_OK);
        for (k = 0; k < width; ++k) {
            const int32_t j = p->ids[k];
            int64_t here, back;
            if (j == i) break;
            HOLDS(p, j >= 0 && j < points && (k == 0 || j > p->ids[k - 1]));
            here = CALL(p, s, peri_bond_is_intact(b, (int32_t)i, j));
            back = CALL(p, s, peri_bond_is_intact(b, j, (int32_t)i));
            HOLDS(p, here == back && (here == 0 || here == 1));
            live += here;
            bonds++;
        }
        for (; k < width; ++k) HOLDS(p, p->ids[k] == i);
    }
    HOLDS(p, bonds == peri_entry_count(b));
    HOLDS(p, live == bonds - 2 * (peri_cut_count(b) + peri_broken_count(b)));
}

#endif
