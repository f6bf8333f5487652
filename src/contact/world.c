/* SPDX-License-Identifier: MIT */
/* world.c - what a world keeps of its bodies, and of the points of one that may touch another's.

   Lengths, times, energies and moduli are in the units of the body that came first, whose origin is that of the world. Each body has a
   seat, with what a unit of its own is in those. Points of all bodies are numbered one after the other, and numbers are not used again:
   so a pair of points is known by them, whoever has left in the meantime. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

struct peri__seat {
    peri_body  *body;
    peri_world *world;
    int64_t  base;      /* number of its first point                                                                        */
    double   origin[3]; /* of its frame                                                                                     */
    double   length, speed, time, mass, volume, stress, energy; /* its own unit of each; volumes and masses with the thickness */
    double   spacing;
    double   least_volume, most_volume, mean_mass, least_density, young; /* of its points; density: mass over volume        */
    double   bound, crowd, hold, growth; /* as of peri__contact, with all others, in the units of the body                  */
    uint8_t *mark;      /* [points] bits of peri__exposure                                                                  */
    int32_t  surveyed;  /* 1: points at surfaces are marked                                                                 */
    int64_t  dead;      /* broken and cut bonds up to which the marks hold; -1: look                                        */
    int64_t  watched, watch_capacity;
    int32_t *watch;     /* [watched] members of mark, ascending                                                             */
    double  *at;        /* [watched][dim] displacement when the lists were made, in units of the body                       */
    double   lo[3], hi[3]; /* the box about them then                                                                       */
    double   allowed;   /* how far they may move before the lists are made anew, in units of the body                      */
    int64_t  begin, end; /* its members in the roll                                                                         */
    int64_t  island;    /* 0: awake; else the number of those with whom it fell asleep                                     */
    int64_t  root;      /* the least seat of those that rest with it: dynamics/sleep.c                                     */
    double   calm;      /* [T] for how long it has rested                                                                  */
    double   pressed;   /* its half of the energy of springs, in the last pass                                             */
    int32_t  placed;    /* 1: it sleeps, and the last pass holds for it                                                     */
};

typedef struct peri__roll { /* points of all bodies that may touch those of others, by seat, then ascending                */
    int64_t  members, entries;
    int32_t *seat, *point, *touching; /* [members] touching: how many, in the last pass                                    */
    double  *place, *motion, *spring; /* [members][dim] in the last pass: place, velocity, force of springs               */
    double  *push, *drag;   /* [members][dim] in the last step: all of the force, and that of dashpots and friction        */
    double  *young, *volume, *mass; /* [members]                                                                            */
    int64_t *begin;         /* [members+1] row of a member among the entries                                                */
    int32_t *other;         /* [entries] members of other bodies                                                            */
    double  *reach2;        /* [entries] square of the distance at which they touch                                         */
} peri__roll;

/* Points of two bodies that were near when the later one came: they do not touch at the distance of then, so that bodies that are put
   together are at rest. */
typedef struct peri__born {
    int64_t later, former; /* numbers; ascending                                                                            */
    double  square;        /* of the distance                                                                               */
} peri__born;

struct peri_world {
    peri__memory memory;
    peri_error   error;
    peri_body   *failed;    /* whose error that is; or NULL                                                                 */
    int32_t      dim;       /* 0: nobody has come yet                                                                       */
    int32_t      running, listed, resists;
    int32_t      overdue;   /* 1: new lists were due and memory short                                                       */
    double       sleep_speed, sleep_time; /* of the caller; sleep_speed 0: nobody sleeps                                   */
    int64_t      islands, sleepers; /* numbers given so far; bodies asleep                                                 */
    double       length, time, energy, stress, origin[3]; /* the units                                                      */
    int64_t      numbers;   /* given so far                                                                                 */
    int64_t      seats, seat_capacity, touch_capacity, born, born_capacity;
    peri__seat **seat;      /* [seats] in the order in which they came                                                       */
    peri__touch *touch;     /* [pairs of seats] see peri__seats_of; their stiffness is over the means of moduli and volumes  */
    peri__born  *pair;      /* [born]                                                                                       */
    peri_contact_desc common; /* of bodies that come; common_on: 1: of any                                                  */
    int32_t      common_on;
    peri__roll   roll;
    double       stored, put_in; /* energy of contact when the last run ended; put in by the caller's changes              */
    void        *paces;     /* of a run, see dynamics/world.c, pace_bytes of them                                            */
    int64_t      pace_bytes;
};

/* Of two seats, a != b. */
static int64_t peri__seats_of(int64_t a, int64_t b) { return a > b ? a * (a - 1) / 2 + b : b * (b - 1) / 2 + a; }

/* ---- memory ---------------------------------------------------------------------------------------------------------- */

#define PERI_ROLLED 13

static void peri__list_rolled(int32_t dim, peri__grown *list) {
    const peri__grown arrays[PERI_ROLLED] = {
        { offsetof(peri__roll, seat), sizeof(int32_t), 1, 0, 0 },     { offsetof(peri__roll, point), sizeof(int32_t), 1, 0, 0 },
        { offsetof(peri__roll, touching), sizeof(int32_t), 1, 0, 0 }, { offsetof(peri__roll, place), sizeof(double), dim, 0, 0 },
        { offsetof(peri__roll, motion), sizeof(double), dim, 0, 0 },  { offsetof(peri__roll, spring), sizeof(double), dim, 0, 0 },
        { offsetof(peri__roll, push), sizeof(double), dim, 0, 0 },    { offsetof(peri__roll, drag), sizeof(double), dim, 0, 0 },
        { offsetof(peri__roll, young), sizeof(double), 1, 0, 0 },     { offsetof(peri__roll, volume), sizeof(double), 1, 0, 0 },
        { offsetof(peri__roll, mass), sizeof(double), 1, 0, 0 },      { offsetof(peri__roll, begin), sizeof(int64_t), 1, 1, 0 },
        { offsetof(peri__roll, other), sizeof(int32_t), 1, 0, 1 },
    };
    memcpy(list, arrays, sizeof arrays);
}

static void peri__free_roll(const peri_world *w, peri__roll *roll) {
    peri__grown arrays[PERI_ROLLED];
    peri__list_rolled(w->dim, arrays);
    for (int k = 0; k < PERI_ROLLED; ++k)
        peri__delete(&w->memory, peri__grown_at(roll, arrays[k].place), peri__grown_count(&arrays[k], roll->members, roll->entries),
                     arrays[k].size);
    peri__delete(&w->memory, roll->reach2, roll->entries, sizeof *roll->reach2);
    memset(roll, 0, sizeof *roll);
}

/* 0 where memory is short. */
static int peri__new_roll(const peri_world *w, peri__roll *roll, int64_t members, int64_t entries) {
    peri__grown arrays[PERI_ROLLED];
    int ok = 1;
    memset(roll, 0, sizeof *roll);
    roll->members = members;
    roll->entries = entries;
    peri__list_rolled(w->dim, arrays);
    for (int k = 0; k < PERI_ROLLED && ok; ++k) {
        void *made = peri__new(&w->memory, peri__grown_count(&arrays[k], members, entries), arrays[k].size);
        ok = made != NULL;
        memcpy((char *)roll + arrays[k].place, &made, sizeof made);
    }
    if (ok) roll->reach2 = (double *)peri__new(&w->memory, entries, sizeof *roll->reach2);
    if (ok && roll->reach2) return 1;
    peri__free_roll(w, roll);
    return 0;
}

static int64_t peri__roll_bytes(const peri_world *w) {
    const peri__roll *roll = &w->roll;
    peri__grown arrays[PERI_ROLLED];
    uint64_t bytes = 0;
    if (!roll->begin) return 0;
    peri__list_rolled(w->dim, arrays);
    for (int k = 0; k < PERI_ROLLED; ++k)
        bytes += peri__block_bytes(peri__grown_count(&arrays[k], roll->members, roll->entries), arrays[k].size);
    return (int64_t)(bytes + peri__block_bytes(roll->entries, sizeof *roll->reach2));
}

/* ---- who comes and goes ---------------------------------------------------------------------------------------------- */

static void peri__free_seat(const peri_world *w, peri__seat *s) {
    if (!s) return;
    peri__delete(&w->memory, s->at, s->watch_capacity * w->dim, sizeof *s->at);
    peri__delete(&w->memory, s->watch, s->watch_capacity, sizeof *s->watch);
    peri__delete(&w->memory, s->mark, s->body->model->points, 1);
    peri__delete(&w->memory, s, 1, sizeof *s);
}

/* What touches a body from outside wakes it, and all that fell asleep with it. */
static void peri__rouse(peri__seat *s) {
    if (!s) return;
    peri_world *w = s->world;
    const int64_t island = s->island;
    s->calm = 0.0;
    if (!island) return;
    for (int64_t k = 0; k < w->seats; ++k) {
        peri__seat *t = w->seat[k];
        if (t->island != island) continue;
        t->calm = 0.0;
        t->island = 0;
        t->placed = 0;
        w->sleepers--;
    }
}

static void peri__rouse_all(peri_world *w) {
    for (int64_t k = 0; k < w->seats; ++k) peri__rouse(w->seat[k]);
}

/* Every bond of the body is looked at again, and the lists are made anew. */
static void peri__forget_seat(peri__seat *s) {
    if (!s) return;
    peri__rouse(s);
    s->surveyed = 0;
    s->dead = -1;
    s->world->listed = 0;
    memset(s->mark, 0, (size_t)s->body->model->points);
    for (int64_t p = s->begin * s->world->dim; p < s->end * s->world->dim; ++p) s->world->roll.push[p] = s->world->roll.drag[p] = 0.0;
}

/* What contact has done to a body before it comes, or until it leaves, is not of the ledger of the world. sign: 1 or -1. */
static void peri__carry_ledger(peri__seat *s, double sign) {
    const peri__ledger *ledger = &s->body->now.ledger;
    if (s->body->desc.ledger) s->world->put_in += sign * (ledger->others + ledger->rubbed) * s->energy;
}

/* The lists, which name bodies by their seats, end with one that leaves; nobody has pushed anybody then. */
static void peri__leave_world(peri_body *b) {
    peri__seat *s = b->seat;
    int64_t k = 0, kept = 0;
    if (!s) return;
    peri_world *w = s->world;
    peri__rouse(s);
    peri__carry_ledger(s, -1.0);
    for (k = 0; k < w->seats; ++k)
        if (w->seat[k]->body->now.pushed) w->seat[k]->body->now.stale |= PERI__STALE_FORCE | PERI__STALE_BALANCE;
    for (k = 0; w->seat[k] != s;) ++k;
    for (int64_t a = 1; a < w->seats; ++a)
        for (int64_t c = 0; c < a; ++c)
            if (a != k && c != k) w->touch[kept++] = w->touch[peri__seats_of(a, c)];
    for (kept = 0; k + 1 < w->seats; ++k) w->seat[k] = w->seat[k + 1];
    w->seats--;
    for (k = 0; k < w->born; ++k) {
        const int64_t last = s->base + b->model->points, later = w->pair[k].later, former = w->pair[k].former;
        if ((later < s->base || later >= last) && (former < s->base || former >= last)) w->pair[kept++] = w->pair[k];
    }
    w->born = kept;
    for (k = 0; k < w->seats; ++k) {
        w->seat[k]->begin = w->seat[k]->end = 0;
        w->seat[k]->placed = 0;
    }
    peri__free_roll(w, &w->roll);
    w->listed = 0;
    if (w->failed == b) w->failed = NULL;
    peri__free_seat(w, s);
    b->seat = NULL;
}

/* ---- from the units of a body to those of its world --------------------------------------------------------------------- */

static void peri__take_units(peri_world *w, const peri__model *m) {
    w->dim = m->dim;
    w->length = m->length;
    w->time = m->time;
    w->energy = m->energy;
    w->stress = m->stress;
    memcpy(w->origin, m->origin, sizeof w->origin);
}

static void peri__set_units(const peri_world *w, const peri__model *m, peri__seat *s) {
    s->length = m->length / w->length;
    s->time = m->time / w->time;
    s->energy = m->energy / w->energy;
    s->stress = m->stress / w->stress;
    s->speed = s->length / s->time;
    s->volume = s->energy / s->stress;
    s->mass = s->energy / peri__square(s->speed);
    s->spacing = m->spacing * s->length;
    for (int32_t d = 0; d < m->dim; ++d) s->origin[d] = (m->origin[d] - w->origin[d]) / w->length;
}

/* What its points weigh and how stiff they are, in the units of the world. */
static void peri__weigh_seat(peri__seat *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    double sum = 0.0;
    s->least_volume = s->least_density = HUGE_VAL;
    s->most_volume = s->young = 0.0;
    for (int64_t i = 0; i < m->points; ++i) {
        const double mass = peri__mass(b, i);
        s->least_volume = fmin(s->least_volume, m->volume[i] * s->volume);
        s->most_volume = fmax(s->most_volume, m->volume[i] * s->volume);
        s->least_density = fmin(s->least_density, mass / m->volume[i] * s->mass / s->volume);
        s->young = fmax(s->young, m->laws[m->material[i]].young * s->stress);
        sum += mass * s->mass;
    }
    s->mean_mass = sum / (double)m->points;
}

static double peri__mean_of_two(double a, double b) { return 2.0 * a * b / (a + b); }
