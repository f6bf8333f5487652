/* SPDX-License-Identifier: MIT */
/* near.c - which points of the bodies of a world may touch those of others: the roll, kept for as long as nothing has moved far.

   As in search.c, with what a pair of bodies asks for in the place of what a pair of materials does: a skin of PERI_SKIN of their own
   distance, so that lists of fine bodies hold beside coarse ones. Of a body that is far from all others nothing is listed, and its points
   may move until half of the gap between the boxes is used up. Two points that are not exposed do not touch, which is asked as they
   meet: forces depend on the state alone. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__quest { /* a search under way                                                                          */
    peri_world *world;
    int32_t     born;    /* 1: for pairs of the last body that are near now, among all points; 0: for what may touch        */
    int64_t     members;
    double     *reach;   /* [pairs] beyond which nothing is of interest; 0: all is not                                     */
    int32_t    *seat, *point; /* [members]                                                                                  */
    double     *place;   /* [members][dim]                                                                                  */
    int64_t    *begin;   /* [members+1]                                                                                     */
    peri__grid  grid;
} peri__quest;

/* Where point i of a body is. */
static void peri__locate(const peri__seat *s, int64_t i, double *place) {
    const peri_body *b = s->body;
    for (int32_t d = 0; d < b->dim; ++d) {
        const int64_t at = d * b->model->stride + i;
        place[d] = s->origin[d] + s->length * (peri__get_real(b->model->x, b->f32, at) + peri__get_real(b->u, b->f32, at));
    }
}

/* ---- who is watched ----------------------------------------------------------------------------------------------------- */

/* Lists the members of the marks of a body, where they are, and the box about them. 0 where memory is short. */
static int peri__watch_body(const peri_world *w, peri__seat *s) {
    const peri_body *b = s->body;
    int64_t at = 0;
    const int ok = s->surveyed || peri__mark_surfaces(s->body, s->mark);
    s->surveyed = ok;
    if (!ok) return 0;
    const int64_t watched = peri__mark_members(b, s->mark);
    if (watched > s->watch_capacity) {
        const int64_t room = watched + watched / 4;
        int32_t *watch = (int32_t *)peri__new(&w->memory, room, sizeof *watch);
        double *where = (double *)peri__new(&w->memory, room * w->dim, sizeof *where);
        if (!watch || !where) {
            peri__delete(&w->memory, where, room * w->dim, sizeof *where);
            peri__delete(&w->memory, watch, room, sizeof *watch);
            return 0;
        }
        peri__delete(&w->memory, s->at, s->watch_capacity * w->dim, sizeof *s->at);
        peri__delete(&w->memory, s->watch, s->watch_capacity, sizeof *s->watch);
        s->watch = watch;
        s->at = where;
        s->watch_capacity = room;
    }
    s->watched = watched;
    for (int64_t i = 0; i < b->model->points; ++i)
        if (s->mark[i] & PERI__MEMBER) s->watch[at++] = (int32_t)i;
    return 1;
}

static int64_t peri__sought(const peri__quest *k, const peri__seat *s) { return k->born ? s->body->model->points : s->watched; }

static int64_t peri__sought_point(const peri__quest *k, const peri__seat *s, int64_t n) { return k->born ? n : s->watch[n]; }

/* The box about what is sought of a body, and where that is. */
static void peri__box_body(const peri__quest *k, peri__seat *s) {
    const peri_body *b = s->body;
    for (int d = 0; d < 3; ++d) s->lo[d] = HUGE_VAL, s->hi[d] = -HUGE_VAL;
    for (int64_t n = 0; n < peri__sought(k, s); ++n) {
        const int64_t i = peri__sought_point(k, s, n);
        double place[3];
        peri__locate(s, i, place);
        for (int32_t d = 0; d < b->dim; ++d) {
            if (place[d] < s->lo[d]) s->lo[d] = place[d];
            if (place[d] > s->hi[d]) s->hi[d] = place[d];
            if (!k->born) s->at[n * b->dim + d] = peri__get_real(b->u, b->f32, d * b->model->stride + i);
        }
    }
}

/* Between the boxes of two bodies; 0 where they meet. */
static double peri__gap_between(const peri_world *w, const peri__seat *s, const peri__seat *t) {
    double square = 0.0;
    for (int32_t d = 0; d < w->dim; ++d) square += peri__square(fmax(0.0, fmax(s->lo[d] - t->hi[d], t->lo[d] - s->hi[d])));
    return sqrt(square);
}

/* May the place be within reach of a body, other than a, that is of interest? */
static int peri__is_within_reach(const peri__quest *k, int64_t a, const double *place) {
    const peri_world *w = k->world;
    for (int64_t c = 0; c < w->seats; ++c) {
        const double reach = c == a ? 0.0 : k->reach[peri__seats_of(a, c)];
        int within = reach > 0.0;
        for (int32_t d = 0; within && d < w->dim; ++d)
            within = place[d] > w->seat[c]->lo[d] - reach && place[d] < w->seat[c]->hi[d] + reach;
        if (within) return 1;
    }
    return 0;
}

/* Drops pairs of bodies that are far from each other from what is of interest, and sets how far each may move. */
static void peri__drop_far(peri__quest *k) {
    peri_world *w = k->world;
    for (int64_t a = 0; a < w->seats; ++a) w->seat[a]->allowed = HUGE_VAL;
    for (int64_t a = 1; a < w->seats; ++a)
        for (int64_t c = 0; c < a; ++c) {
            double *reach = &k->reach[peri__seats_of(a, c)];
            if (!(*reach > 0.0)) continue;
            const double gap = peri__gap_between(w, w->seat[a], w->seat[c]), distance = *reach / (1.0 + PERI_SKIN);
            const double allowed = 0.5 * fmax(PERI_SKIN * distance, 0.999 * gap - distance);
            w->seat[a]->allowed = fmin(w->seat[a]->allowed, allowed / w->seat[a]->length);
            w->seat[c]->allowed = fmin(w->seat[c]->allowed, allowed / w->seat[c]->length);
            if (gap > *reach) *reach = 0.0;
        }
}

/* ---- candidates ---------------------------------------------------------------------------------------------------------- */

static double peri__square_between(const peri_world *w, const double *a, const double *z) {
    double square = 0.0;
    for (int32_t d = 0; d < w->dim; ++d) square += peri__square(z[d] - a[d]);
    return square;
}

static int peri__born_before(const peri__born *a, int64_t later, int64_t former) {
    return a->later < later || (a->later == later && a->former < former);
}

/* The square of the distance that points of these numbers had when the later body came; HUGE_VAL: they were not near. */
static double peri__born_square(const peri_world *w, int64_t one, int64_t other) {
    const int64_t later = one > other ? one : other, former = one > other ? other : one;
    int64_t lo = 0, hi = w->born;
    while (lo < hi) {
        const int64_t middle = lo + (hi - lo) / 2;
        if (peri__born_before(&w->pair[middle], later, former)) lo = middle + 1;
        else hi = middle;
    }
    return lo < w->born && w->pair[lo].later == later && w->pair[lo].former == former ? w->pair[lo].square : HUGE_VAL;
}

/* The members that are of interest to member p, to other[], and the squares of the distance of the touch, or where born of the present one.
   Returns how many; both may be NULL. */
static int64_t peri__list_others(const peri__quest *k, int64_t p, int32_t *other, double *reach2) {
    const peri_world *w = k->world;
    const peri__grid *g = &k->grid;
    const int64_t own = w->seat[k->seat[p]]->base + k->point[p];
    int64_t cell[3], found = 0;
    if (g->bucket[p] < 0) return 0;
    for (int64_t n = 0; n < (w->dim == 3 ? 27 : 9); ++n) {
        const int64_t bucket = peri__cell_about(g, p, n, w->dim == 3, cell);
        for (int32_t o = g->start[bucket]; o < g->start[bucket + 1]; ++o) {
            const int64_t q = g->order[o];
            const int64_t *there = &g->cell[3 * q];
            if (k->seat[p] == k->seat[q] || there[0] != cell[0] || there[1] != cell[1] || there[2] != cell[2]) continue;
            const int64_t pair = peri__seats_of(k->seat[p], k->seat[q]);
            double least = peri__square_between(w, &k->place[p * w->dim], &k->place[q * w->dim]);
            if (!(least < peri__square(k->reach[pair]))) continue;
            if (!k->born) {
                const double before = w->born > 0 ? peri__born_square(w, own, w->seat[k->seat[q]]->base + k->point[q]) : HUGE_VAL;
                const double skin = PERI_SKIN * w->touch[pair].distance, square = least;
                least = fmin(peri__square(w->touch[pair].distance), before);
                if (!(square < peri__square(sqrt(least) + skin))) continue;
            }
            if (other) other[found] = (int32_t)q;
            if (reach2) reach2[found] = least;
            found++;
        }
    }
    return found;
}

static void peri__count_others(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__quest *k = (const peri__quest *)context;
    (void)sums;
    for (int64_t p = begin; p < end; ++p) k->begin[p + 1] = peri__list_others(k, p, NULL, NULL);
}

/* Counts the members, or lists them. */
static int64_t peri__list_sought(peri__quest *k) {
    const peri_world *w = k->world;
    int64_t members = 0;
    for (int64_t a = 0; a < w->seats; ++a) {
        const peri__seat *s = w->seat[a];
        if (!(s->allowed < HUGE_VAL)) continue;
        for (int64_t n = 0; n < peri__sought(k, s); ++n) {
            double place[3] = { 0.0, 0.0, 0.0 };
            peri__locate(s, peri__sought_point(k, s, n), place);
            if (!peri__is_within_reach(k, a, place)) continue;
            if (k->seat) {
                k->seat[members] = (int32_t)a;
                k->point[members] = (int32_t)peri__sought_point(k, s, n);
                memcpy(&k->place[members * w->dim], place, (size_t)w->dim * sizeof *place);
                peri__put_in_cell(&k->grid, members, place);
            }
            members++;
        }
    }
    return members;
}

static void peri__end_seek(peri__quest *k) {
    const peri__memory *memory = &k->world->memory;
    const int64_t seats = k->world->seats;
    peri__drop_grid(memory, &k->grid);
    peri__delete(memory, k->begin, k->members + 1, sizeof *k->begin);
    peri__delete(memory, k->place, k->members * k->world->dim, sizeof *k->place);
    peri__delete(memory, k->point, k->members, sizeof *k->point);
    peri__delete(memory, k->seat, k->members, sizeof *k->seat);
    peri__delete(memory, k->reach, seats * (seats - 1) / 2, sizeof *k->reach);
}

/* Begins a search: k->begin then has the rows of the members. 0 where memory is short; to be ended anyhow. */
static int peri__begin_seek(peri_world *w, peri__quest *k, int32_t born) {
    const int64_t seats = w->seats;
    double most = 0.0;
    memset(k, 0, sizeof *k);
    k->world = w;
    k->born = born;
    k->reach = (double *)peri__new(&w->memory, seats * (seats - 1) / 2, sizeof *k->reach);
    if (!k->reach) return 0;
    for (int64_t a = 1; a < seats; ++a)
        for (int64_t c = 0; c < a; ++c) {
            const int64_t pair = peri__seats_of(a, c);
            if (born && a == seats - 1) k->reach[pair] = w->seat[a]->spacing + w->seat[c]->spacing;
            if (!born && w->touch[pair].on) k->reach[pair] = (1.0 + PERI_SKIN) * w->touch[pair].distance;
        }
    for (int64_t a = 0; a < seats; ++a) {
        if (!born && !peri__watch_body(w, w->seat[a])) return 0;
        peri__box_body(k, w->seat[a]);
    }
    peri__drop_far(k);
    for (int64_t pair = 0; pair < seats * (seats - 1) / 2; ++pair) most = fmax(most, k->reach[pair]);
    k->grid.edge = most > 0.0 ? 1.25 * most : 1.0; /* as in search.c */
    const int64_t members = most > 0.0 ? peri__list_sought(k) : 0;
    k->members = k->grid.members = members;
    k->point = (int32_t *)peri__new(&w->memory, members, sizeof *k->point);
    k->place = (double *)peri__new(&w->memory, members * w->dim, sizeof *k->place);
    k->begin = (int64_t *)peri__new(&w->memory, members + 1, sizeof *k->begin);
    if (!k->point || !k->place || !k->begin || !peri__take_grid(&w->memory, &k->grid)) return 0;
    k->seat = (int32_t *)peri__new(&w->memory, members, sizeof *k->seat);
    if (!k->seat) return 0;
    if (members > 0) (void)peri__list_sought(k);
    peri__sort_grid(&k->grid);
    peri__for_points(w->seat[0]->body, members, 20, peri__count_others, k, NULL);
    for (int64_t p = 0; p < members; ++p) k->begin[p + 1] += k->begin[p];
    return 1;
}

/* ---- the roll ------------------------------------------------------------------------------------------------------------ */

typedef struct peri__rolling { /* a search, and what it fills                                                               */
    const peri__quest *seek;
    peri__roll       *roll;
} peri__rolling;

static void peri__fill_roll(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__rolling *r = (const peri__rolling *)context;
    (void)sums;
    for (int64_t p = begin; p < end; ++p)
        (void)peri__list_others(r->seek, p, &r->roll->other[r->roll->begin[p]], &r->roll->reach2[r->roll->begin[p]]);
}

/* Stiffness, volume and mass of the members of a body, in the units of the world. */
static void peri__weigh_members(const peri__seat *s) {
    const peri__roll *roll = &s->world->roll;
    const peri_body *b = s->body;
    for (int64_t p = s->begin; p < s->end; ++p) {
        const int64_t i = roll->point[p];
        roll->young[p] = b->model->laws[b->model->material[i]].young * s->stress;
        roll->volume[p] = b->model->volume[i] * s->volume;
        roll->mass[p] = peri__mass(b, i) * s->mass;
    }
}

/* The new roll takes over what its members had of the last step in the old one, both ascending; the seats their members. */
static void peri__take_roll(peri_world *w, peri__roll *roll) {
    const int32_t dim = w->dim;
    const peri__roll *old = &w->roll;
    int64_t from = 0, at = 0;
    for (int64_t p = 0; p < roll->members; ++p) {
        while (from < old->members
               && (old->seat[from] < roll->seat[p] || (old->seat[from] == roll->seat[p] && old->point[from] < roll->point[p])))
            ++from;
        if (from == old->members || old->seat[from] != roll->seat[p] || old->point[from] != roll->point[p]) continue;
        memcpy(&roll->push[p * dim], &old->push[from * dim], (size_t)dim * sizeof(double));
        memcpy(&roll->drag[p * dim], &old->drag[from * dim], (size_t)dim * sizeof(double));
    }
    peri__free_roll(w, &w->roll);
    w->roll = *roll;
    for (int64_t a = 0; a < w->seats; ++a) {
        peri__seat *s = w->seat[a];
        s->begin = at;
        s->placed = 0;
        while (at < roll->members && roll->seat[at] == a) ++at;
        s->end = at;
        peri__weigh_members(s);
    }
    w->listed = 1;
}

/* Makes the lists anew. 0 where memory is short: the old ones stay. */
static int peri__list_world(peri_world *w) {
    peri__quest k;
    peri__roll roll;
    int ok = peri__begin_seek(w, &k, 0);
    ok = ok && peri__new_roll(w, &roll, k.members, k.begin[k.members]);
    if (ok) {
        peri__rolling rolling = { &k, &roll };
        memcpy(roll.seat, k.seat, (size_t)k.members * sizeof *k.seat);
        memcpy(roll.point, k.point, (size_t)k.members * sizeof *k.point);
        memcpy(roll.begin, k.begin, (size_t)(k.members + 1) * sizeof *k.begin);
        peri__for_points(w->seat[0]->body, k.members, 20, peri__fill_roll, &rolling, NULL);
        peri__take_roll(w, &roll);
    }
    peri__end_seek(&k);
    return ok;
}

/* sums->a: the square of the farthest that a watched point has moved since the lists were made. */
static void peri__strayed_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__seat *s = (const peri__seat *)context;
    const peri_body *b = s->body;
    for (int64_t n = begin; n < end; ++n) {
        double square = 0.0;
        for (int32_t d = 0; d < b->dim; ++d)
            square += peri__square(peri__get_real(b->u, b->f32, d * b->model->stride + s->watch[n]) - s->at[n * b->dim + d]);
        if (!(square <= sums->a)) sums->a = square;
    }
}

static int peri__has_strayed(peri__seat *s) {
    peri_body *b = s->body;
    if (!(s->allowed < HUGE_VAL) || s->island) return 0;
    peri__for_points(b, s->watched, 1, peri__strayed_block, s, b->sums);
    for (int64_t k = 0; k * PERI_BLOCK < s->watched; ++k)
        if (!(b->sums[k].a <= peri__square(s->allowed))) return 1;
    return 0;
}

/* Makes lists that hold for the bodies as they are: 0 where memory is short; the old ones, if any, then nearly do. */
static int peri__ready_world(peri_world *w) {
    int joined = 0, strayed = 0;
    for (int64_t a = 0; a < w->seats; ++a) {
        peri__seat *s = w->seat[a];
        if (s->dead == s->body->now.broken + s->body->now.cut) continue;
        joined |= peri__mark_exposed(s->body, s->mark);
        s->dead = s->body->now.broken + s->body->now.cut;
    }
    for (int64_t a = 0; w->listed && !joined && !strayed && a < w->seats; ++a) strayed = peri__has_strayed(w->seat[a]);
    if (w->listed && !joined && !strayed && !w->overdue) return 1;
    w->listed = w->listed && !joined;
    w->overdue = !peri__list_world(w);
    return !w->overdue;
}

/* ---- bodies that come ---------------------------------------------------------------------------------------------------- */

/* Notes which points of the last body are near those of others. 0 where memory is short: then nothing has changed. */
static int peri__note_born(peri_world *w) {
    peri__quest k;
    const int64_t last = w->seats - 1;
    int64_t count = 0, born = w->born;
    int ok = peri__begin_seek(w, &k, 1);
    if (ok) count = (k.begin[k.members] + 1) / 2;
    ok = ok && peri__grow(&w->memory, &w->pair, &w->born_capacity, w->born + count, sizeof *w->pair);
    int32_t *other = ok ? (int32_t *)peri__new(&w->memory, 2 * count + 1, sizeof *other) : NULL;
    double *square = ok ? (double *)peri__new(&w->memory, 2 * count + 1, sizeof *square) : NULL;
    ok = ok && other && square;
    for (int64_t p = 0; ok && p < k.members; ++p) {
        const int64_t found = k.seat[p] == last ? peri__list_others(&k, p, other, square) : 0, first = born;
        for (int64_t e = 0; e < found; ++e) {
            const peri__born pair = { w->seat[last]->base + k.point[p], w->seat[k.seat[other[e]]]->base + k.point[other[e]], square[e] };
            int64_t at = born++;
            for (; at > first && !peri__born_before(&w->pair[at - 1], pair.later, pair.former); --at) w->pair[at] = w->pair[at - 1];
            w->pair[at] = pair;
        }
    }
    if (ok) w->born = born;
    peri__delete(&w->memory, square, 2 * count + 1, sizeof *square);
    peri__delete(&w->memory, other, 2 * count + 1, sizeof *other);
    peri__end_seek(&k);
    return ok;
}
