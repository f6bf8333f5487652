/* SPDX-License-Identifier: MIT */
/* program.h - random programs: bytes that call the library, in any order, and what must hold after every call.

   SOURCE OF TRUTH: peri.h. A call returns a status that is listed; one that is refused has changed nothing and left its record; one that
   succeeds leaves the record alone; counts agree with each other, damage lies in [0, 1]; a clone moves as its body does, to the last bit.
   As long as no call has reported PERI_ERROR_UNSTABLE displacements and velocities are finite, and so is all that can be read where only
   numbers of ordinary size went in. peri_get_memory is what the allocator counts, and destroying gives everything back. Ids are counted
   from 1 by kind, hold in clones, and whatever is none is refused by the status that says why: a plain number, another kind, another body,
   or nothing that there is.

   A program is: scene, then calls. Each call takes a byte for which, a byte for the mood (see begin_call), then what it asks for; past the
   end all bytes are 0. The bytes kept in program_corpus.h mean what they mean by this decoding: let calls be added at the end of the table
   in program_run.h only. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include "../peri.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SLOTS 2
#define HOOKS 1024          /* more than a program can ask for: each has its own                                          */
#define LEVELS 16
#define POINTS_MOST 150     /* of a body that is built                                                                   */
#define SITES_MOST 3000     /* of a shape                                                                                */
#define POOL_BYTES 4000000  /* beyond this the allocator returns NULL                                                    */
#define CALLS_MOST 60       /* of a program                                                                              */
#define IDS_KNOWN 1024      /* of a kind; more than a program makes                                                      */
#define ROOM (8 * POINTS_MOST)

typedef struct program program;

typedef struct pool {
    int64_t blocks, bytes, calls;
    int64_t fail_at; /* call that returns NULL; -1: none                                                                 */
    int64_t refused;
    int     wrong;   /* releases of another size, or writes just before a block                                          */
} pool;

typedef struct slot {
    peri_body *body;
    int32_t    space, dim;
    double     length, stress, density; /* ordinary sizes here                                                           */
    double     lo[3], hi[3];            /* [L] around the points                                                         */
    int        busy;                    /* calls of the body that are under way                                          */
    int        wild;                    /* a number beyond ordinary size went in                                         */
    int        lost;                    /* a call has reported an instability since the last reset                       */
    int        family;                  /* bodies of one family share their points                                       */
    int        heavy;                   /* its build costs more than others                                              */
    int        quadrature;
    int32_t    number;                  /* of the body, where it was given one                                           */
    int32_t    given[5];                /* ids given out, by the kind less PERI_KIND_MATERIAL plus 1                     */
    uint8_t    removed[5][IDS_KNOWN];   /* what has gone again, by its index                                             */
    peri_error record;
} slot;

/* What a callback does. It keeps no count where results depend on it, so clones see the same. */
typedef struct hook {
    program *p;
    int32_t  kind, dim;
    double   size, time;
} hook;

struct program {
    const uint8_t *at, *end;
    pool           memory;
    slot           slots[SLOTS];
    hook           hooks[HOOKS];
    int            hook_count;
    int            running[LEVELS], level; /* slots of the calls under way                                               */
    int64_t        refused[LEVELS];        /* by the allocator before each of them                                       */
    int32_t        wants[LEVELS];          /* how each of them must end because of its ids; PERI_OK: these are right     */
    const char    *names[LEVELS];
    int            calls, families, frames_left, iterations_left;
    int            partial;            /* 1: the call may have changed the body though it failed; PARTLY: but not its motion */
    int            mood;
    int            nulls;              /* the pointer argument that is NULL; -1: none                                    */
    int32_t        want;               /* of the call to come                                                            */
    int            wild;               /* the present call has got a number beyond ordinary size                         */
    peri_matrix   *matrix;
    int64_t        matrix_bytes;
    const char    *fault;              /* the first thing that did not hold, where, and in which call                    */
    const char    *fault_call;
    int            fault_line, trace;
    double         in[ROOM], out[ROOM], other[ROOM];
    int32_t        ids[ROOM];
};

#define HOLDS(p, condition)                                                                                            \
    do {                                                                                                               \
        if (!(condition)) blame((p), #condition, __LINE__);                                                            \
    } while (0)

static void blame(program *p, const char *text, int line) {
    if (p->fault) return;
    p->fault = text;
    p->fault_line = line;
    if (p->trace) printf("    here: line %d: not true: %s\n", line, text);
    p->fault_call = p->level > 0 ? p->names[p->level - 1] : "";
}

/* ---- the allocator ------------------------------------------------------------------------------------------------ */

static const uint64_t pool_mark = UINT64_C(0x5EED0F5EED0F5EED);

/* Memory full of NaN, ids of -1. */
static void *pool_allocate(void *user, uint64_t bytes) {
    pool *m = (pool *)user;
    unsigned char *raw;
    if (m->calls++ == m->fail_at || bytes > (uint64_t)(POOL_BYTES - m->bytes)) {
        m->refused++;
        return NULL;
    }
    raw = (unsigned char *)malloc((size_t)bytes + 16);
    if (!raw) return NULL;
    memset(raw + 16, 0xFF, (size_t)bytes);
    memcpy(raw, &bytes, 8);
    memcpy(raw + 8, &pool_mark, 8);
    m->blocks++;
    m->bytes += (int64_t)bytes;
    return raw + 16;
}

static void pool_release(void *user, void *pointer, uint64_t bytes) {
    pool *m = (pool *)user;
    unsigned char *raw = (unsigned char *)pointer - 16;
    uint64_t size, mark;
    if (!pointer) return;
    memcpy(&size, raw, 8);
    memcpy(&mark, raw + 8, 8);
    if (size != bytes || mark != pool_mark) {
        m->wrong++;
        return;
    }
    m->blocks--;
    m->bytes -= (int64_t)bytes;
    memset(raw, 0x55, (size_t)bytes + 16);
    free(raw);
}

/* ---- bytes to numbers --------------------------------------------------------------------------------------------- */

/* One expression draws once: the order in which C evaluates arguments is not given. */

static int draw(program *p) { return p->at < p->end ? *p->at++ : 0; }

static int below(program *p, int n) { return draw(p) % n; }

enum { PARTLY = 2 }; /* the ledger may have been brought up to date                                                */

enum { MOOD_NUMBERS = 1, MOOD_CHOICES, MOOD_NULLS, MOOD_MEMORY };

/* One mood in four is bad: numbers beyond all sizes, choices that there are not, a NULL, an allocator that fails. */
static void begin_call(program *p) {
    int mood = draw(p);
    p->mood = mood % 4 == 3 ? 1 + mood / 4 % 4 : 0;
    p->nulls = p->mood == MOOD_NULLS ? mood / 16 % 4 : -1;
    p->wild = p->partial = 0;
    p->memory.fail_at = p->mood == MOOD_MEMORY ? p->memory.calls + mood / 16 + 16 * (draw(p) % 3) : -1;
}

static double evil_number(program *p) {
    static const double evil[] = {0.0,    -1.0,   1e300,   -1e300, 1e-300, 4.9e-324, DBL_MAX, -DBL_MAX, (double)NAN, HUGE_VAL, -HUGE_VAL,
                                  1e-30,  1e30,   1e9,     -1e9,   1e-9,   1e15,     -0.0,    1e-15,    3.5e38,      0.3,      1e6};
    p->wild = 1;
    return evil[below(p, (int)(sizeof evil / sizeof *evil))];
}

/* A number in steps of a 32nd from lo to hi. */
static double number(program *p, double lo, double hi) {
    if (p->mood == MOOD_NUMBERS && draw(p) % 2) return evil_number(p);
    return lo + (hi - lo) * (double)(draw(p) % 33) / 32.0;
}

/* One of `count` choices from `first` on, or none of them: of another enum, say. */
static int32_t choice(program *p, int32_t first, int32_t count) {
    const int32_t none[] = {0, -1, first % 100, INT32_MAX, INT32_MIN, first + 100};
    if (p->mood == MOOD_CHOICES && draw(p) % 2) return none[below(p, 6)];
    return first + draw(p) % count;
}

/* The number of a point, or none. */
static int32_t some_point(program *p, int64_t count) {
    static const int32_t none[] = {-1, -17, INT32_MAX, INT32_MIN, 1 << 30};
    if (p->mood == MOOD_CHOICES && draw(p) % 2) return draw(p) % 2 ? (int32_t)count : none[below(p, 5)];
    const int low = draw(p), high = draw(p);
    return count > 0 ? (int32_t)((low + 256 * high) % count) : 0;
}

static int place_of(int32_t kind) { return kind - PERI_KIND_MATERIAL + 1; }

/* The first id that is wrong says how the call must end. */
static int32_t want_id(program *p, int32_t status, int32_t id) {
    if (p->want == PERI_OK) p->want = status;
    return id;
}

static int32_t id_at(program *p, int s, int32_t kind, int32_t index) {
    const slot *o = &p->slots[s];
    const int32_t id = peri_id(o->body, kind, index);
    HOLDS(p, id > 0 && id >> 27 == place_of(kind) && PERI_ID_INDEX(id) == index && (!o->number || (id >> 20 & 127) == o->number));
    return want_id(p, o->removed[place_of(kind)][index % IDS_KNOWN] ? PERI_ERROR_ID_GONE : PERI_OK, id);
}

/* What is no id of this kind and body: a plain number, one of another kind, of another body, or of what is not there. */
static int32_t wrong_id(program *p, int s, int32_t kind) {
    static const int32_t plain[] = {0, 1, 2, -1, -17, INT32_MIN, PERI_KIND_SET, 1 << 20, (1 << 27) - 1};
    const slot *o = &p->slots[s];
    const int32_t tag = place_of(kind), way = draw(p), more = way / 5;
    const int32_t known = o->given[1] > 0 ? peri_id(o->body, PERI_KIND_MATERIAL, 1) - 1 + ((tag - 1) << 27) : 0; /* index 0 */
    switch (known ? way % 5 : 0) {
    case 0: return want_id(p, PERI_ERROR_ID_NONE, plain[more % 9]);
    case 1: return want_id(p, PERI_ERROR_ID_KIND, known + 1 + ((more % (15 - tag) + 1) << 27));
    case 2: return want_id(p, PERI_ERROR_ID_BODY, (known + 1) ^ (1 + more) << 20);
    case 3: return tag == 2 ? PERI_ALL : want_id(p, PERI_ERROR_ID_KIND, more % 2 ? PERI_ALL : INT32_MAX);
    default: return want_id(p, PERI_ERROR_ID_GONE, more % 2 ? known + o->given[tag] + 1 : known);
    }
}

/* An id of something, or of nothing. */
static int32_t some_id(program *p, int s, int32_t kind) {
    const int32_t count = p->slots[s].given[place_of(kind)], sets = kind == PERI_KIND_SET;
    if (p->mood == MOOD_CHOICES && draw(p) % 2) return wrong_id(p, s, kind);
    const int low = draw(p), high = draw(p), at = low + 256 * high;
    if (sets) return at % (count + 1) == 0 ? PERI_ALL : id_at(p, s, kind, at % (count + 1));
    return count > 0 ? id_at(p, s, kind, 1 + at % count) : want_id(p, PERI_ERROR_ID_NONE, 0);
}

/* Ids are given in order; what a call returned that failed is none. */
static void note_id(program *p, int s, int32_t kind, int64_t id) {
    slot *o = &p->slots[s];
    if (id < 0 || !o->body) return;
    o->given[place_of(kind)]++;
    HOLDS(p, id == peri_id(o->body, kind, o->given[place_of(kind)]));
}

static int64_t number_of(program *p, int64_t first, int64_t count) {
    static const int64_t none[] = {0, -1, INT64_MAX, INT64_MIN, INT64_C(1) << 40, INT32_MAX};
    if (p->mood == MOOD_CHOICES && draw(p) % 2) return none[below(p, 6)];
    return first + draw(p) % count;
}

/* Argument k: the pointer, or NULL where the mood asks for that. */
#define GIVEN(k, pointer) (p->nulls == (k) ? NULL : (pointer))

/* A place in or near the body; a third lie on its corners, edges and middle lines. */
static void place(program *p, const slot *s, double *x) {
    int d;
    for (d = 0; d < 3; ++d) {
        const double edge = s->hi[d] - s->lo[d];
        x[d] = draw(p) % 3 ? number(p, s->lo[d] - 0.25 * edge, s->hi[d] + 0.25 * edge) : number(p, s->lo[d], s->lo[d] + 16.0 * edge);
        if (x[d] > s->hi[d] + 0.3 * edge) x[d] = s->lo[d] + 0.5 * edge * floor(2.0 * (x[d] - s->lo[d]) / (16.0 * edge) + 0.5);
    }
}

static void vector(program *p, double size, double *x) {
    int d;
    for (d = 0; d < 3; ++d) x[d] = number(p, -size, size);
}

/* ---- hooks: what callbacks do ------------------------------------------------------------------------------------- */

static void    enter(program *p, int s, const char *text);
static int64_t told(program *p, int s, int64_t status, int line);

/* A call of a body that may be refused. Yields its status. */
#define CALL(p, s, call) told((p), (s), (enter((p), (s), #call), (int64_t)(call)), __LINE__)

static hook *new_hook(program *p, int s, int32_t kinds) {
    hook *h = &p->hooks[p->hook_count < HOOKS ? p->hook_count++ : 0];
    h->p = p;
    h->kind = below(p, kinds);
    h->dim = p->slots[s].dim;
    h->size = 0.25 * below(p, 16);
    h->time = (double)below(p, 4);
    return h;
}

/* Every change to the body under way must be refused, and destroying it ignored. */
static void meddle(program *p) {
    const double v[3] = {1.0, 1.0, 1.0};
    const int s = p->level > 0 ? p->running[p->level - 1] : 0;
    peri_body *b = p->slots[s].body, *copy = NULL;
    peri_energy energy;
    peri_view view;
    p->partial = 1;
    if (!b || p->level + 2 > LEVELS) return;
    if (peri_entry_count(b) > 0) {
        HOLDS(p, CALL(p, s, peri_get_energy(b, &energy)) == PERI_OK);
        HOLDS(p, CALL(p, s, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, p->other, ROOM)) == PERI_OK);
        (void)CALL(p, s, peri_view_field(b, PERI_FIELD_DAMAGE, &view));
        HOLDS(p, CALL(p, s, peri_reset(b)) == PERI_ERROR_ORDER);
        HOLDS(p, CALL(p, s, peri_add_velocity(b, PERI_ALL, v)) == PERI_ERROR_ORDER);
        HOLDS(p, CALL(p, s, peri_apply_body_force(b, PERI_ALL, v, NULL, NULL)) == PERI_ERROR_ORDER);
        HOLDS(p, peri_body_clone(b, &copy, NULL) == PERI_ERROR_ORDER && !copy);
    }
    HOLDS(p, CALL(p, s, peri_build(b)) == PERI_ERROR_ORDER);
    peri_body_destroy(b);
    HOLDS(p, peri_dimension(b) == p->slots[s].dim);
}

enum { LOAD_KEEPS, LOAD_WAVES, LOAD_VARIES, LOAD_MEDDLES, LOAD_FAILS, LOAD_BURSTS, LOAD_KINDS };

static int32_t on_load(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const hook *h = (const hook *)user;
    int64_t k;
    for (k = 1; k < count; ++k) HOLDS(h->p, points[k - 1] < points[k]);
    for (k = 0; k < count * h->dim; ++k) {
        if (h->kind == LOAD_WAVES) value[k] *= cos(time * h->size + (double)k);
        if (h->kind == LOAD_VARIES) value[k] *= 1.0 + 0.25 * (double)(points[k / h->dim] % 5);
        if (h->kind == LOAD_FAILS && time > 0.0) value[k] = k % 2 ? (double)NAN : HUGE_VAL;
        if (h->kind == LOAD_BURSTS) value[k] = k % 2 ? 1e300 : -1e300;
    }
    if (h->kind == LOAD_MEDDLES) meddle(h->p);
    return 0;
}

enum { MOVE_RESTS, MOVE_SWINGS, MOVE_MEDDLES, MOVE_FAILS, MOVE_KINDS };

static int32_t on_motion(void *user, double time, double *where, double *turn) {
    const hook *h = (const hook *)user;
    if (h->kind == MOVE_SWINGS) where[0] += h->size * sin(time);
    if (h->kind == MOVE_SWINGS) turn[0] += sin(time);
    if (h->kind == MOVE_MEDDLES) meddle(h->p);
    if (h->kind == MOVE_FAILS && time > 0.0) where[0] = (double)NAN;
    return 0;
}

static int32_t on_point(void *user, int64_t index, const double *x) {
    const hook *h = (const hook *)user;
    if (h->kind == 3 && index % 32 == 5) meddle(h->p);
    return h->kind == 0 ? 1 : h->kind == 1 ? 0 : h->kind == 2 ? index % 3 != 0 : x[0] + x[1] > h->size;
}

static int32_t on_pair(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const hook *h = (const hook *)user;
    HOLDS(h->p, i < j && xi && xj);
    if (h->kind == 3 && i % 32 == 5) meddle(h->p);
    return h->kind == 0 ? 1 : h->kind == 1 ? 0 : h->kind == 2 ? (i + j) % 3 == 0 : xi[0] < xj[0];
}

static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    const hook *h = (const hook *)user;
    HOLDS(h->p, i < j && !(time < 0.0 && time > 0.0) && stretch != 0.0);
    if (h->kind == 1) meddle(h->p);
    return 0;
}

enum { INFLUENCE_ONE, INFLUENCE_FALLS, INFLUENCE_DECAYS, INFLUENCE_NEGATIVE, INFLUENCE_FAILS, INFLUENCE_NONE, INFLUENCE_HUGE,
       INFLUENCE_TINY, INFLUENCE_KINDS };

static int32_t on_influence(void *user, double q, double *w) {
    const hook *h = (const hook *)user;
    HOLDS(h->p, q > 0.0);
    switch (h->kind) {
    case INFLUENCE_FALLS: { *w = 1.0 - 0.5 * q; return 0; }
    case INFLUENCE_DECAYS: { *w = exp(-q); return 0; }
    case INFLUENCE_NEGATIVE: { *w = 0.5 - q; return 0; }
    case INFLUENCE_FAILS: { *w = q > 0.5 ? (double)NAN : 1.0; return 0; }
    case INFLUENCE_NONE: { *w = 0.0; return 0; }
    case INFLUENCE_HUGE: { *w = 1e300; return 0; }
    case INFLUENCE_TINY: { *w = 1e-300; return 0; }
    default: { *w = 1.0; return 0; }
    }
}

static int32_t on_write(void *user, const void *bytes, int64_t count) {
    const hook *h = (const hook *)user;
    HOLDS(h->p, bytes && count > 0);
    if (h->kind == 1) meddle(h->p);
    return h->kind == 2;
}

static void on_log(void *user, int32_t level, const char *text) {
    program *p = (program *)user;
    HOLDS(p, (level == 0 || level == 1) && text && text[0]);
    if (p->level > 0 && p->slots[p->running[p->level - 1]].body) {
        peri_body *b = p->slots[p->running[p->level - 1]].body;
        peri_body_destroy(b);
        HOLDS(p, peri_dimension(b) >= 2);
    }
}

/* The caller's job system: the last first. */
static void in_reverse(void *user, int64_t count, peri_task_fn task, void *context) {
    int64_t k;
    (void)user;
    for (k = count - 1; k >= 0; --k) task(context, k);
}

#endif
