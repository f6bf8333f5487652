/* SPDX-License-Identifier: MIT */
/* search.c - which points of a body may touch: lists of candidates, kept for as long as nothing has moved far.

   Only exposed points can touch: those at a surface, which have a small family, and those that lost a bond. They have rows of
   candidates; so have the neighbours of those that lost a bond, so that a growing crack makes new lists once per horizon and not once per
   step. Candidates are sought on a grid of cells that is anchored in the frame and hashed: no distance between the parts of a body matters.
   They are listed out to a skin beyond their distance; the lists hold until twice the largest motion passes that.

   A row ascends by point. Its first entries are open; behind them sleep pairs whose bond lives or of which one is not exposed. Pairs that
   do not touch add nothing, so forces depend on the state alone and not on when the lists were made: clones, which make their own, go on
   with the same bits. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_SKIN 0.3 /* of the largest distance: longer lists against rarer searches                                        */

typedef struct peri__grid { /* members by cells, hashed                                                                    */
    int64_t  members, buckets;
    int64_t *cell;    /* [members][3]                                                                                       */
    int32_t *bucket;  /* [members] hash of the cell; -1: at no place that can be reckoned with                              */
    int32_t *start;   /* [buckets+1] of the order                                                                            */
    int32_t *order;   /* [members] by bucket, then ascending                                                                 */
    double   edge;
} peri__grid;

typedef struct peri__hunt { /* a search under way                                                                          */
    peri_body     *body;
    peri__contact *contact;
    peri__grid grid;
    int32_t *member;  /* [members]                                                                                          */
    int64_t *begin;   /* [members+1]                                                                                        */
    double   skin;
} peri__hunt;

/* From i to j where they are, and the square of the distance; seen from j the same with the other sign, to the last bit. Bodies that have
   not moved get the bond of the reference, to the last bit. */
static double peri__between(const peri_body *b, int64_t i, int64_t j, double *r) {
    const peri__model *m = b->model;
    double square = 0.0;
    for (int32_t d = 0; d < m->dim; ++d) {
        const int64_t p = d * m->stride + i, q = d * m->stride + j;
        r[d] = (peri__get_real(m->x, b->f32, q) - peri__get_real(m->x, b->f32, p))
             + (peri__get_real(b->u, b->f32, q) - peri__get_real(b->u, b->f32, p));
        square += r[d] * r[d];
    }
    return square;
}

/* The square of the distance at which i and j touch: they never do at that of the reference, so that a body is born at rest. */
static double peri__reach2(const peri_body *b, const peri__touch *touch, int64_t i, int64_t j) {
    double xi[3];
    peri__bond_of(b->model, b->f32, i, j, xi);
    return fmin(peri__square(touch->distance), peri__dot(xi, xi, b->dim));
}

static const peri__touch *peri__touch_of(const peri_body *b, int64_t i, int64_t j) {
    const peri__model *m = b->model;
    return &b->contact->touch[m->material[i] * m->materials + m->material[j]];
}

/* May points i and j not touch, i having this bond to j? */
static int peri__sleeps(const peri_body *b, int64_t i, int64_t j, int32_t bond) {
    return !(b->contact->mark[i] & b->contact->mark[j] & PERI__EXPOSED) || (bond >= 0 && peri__is_alive(b, i, bond));
}

typedef struct peri__survey {
    peri_body *body;
    double    *seen; /* [points] volume of the family                                                                       */
} peri__survey;

/* ---- members ------------------------------------------------------------------------------------------------------- */

static int peri__lost_a_bond(const peri_body *b, int64_t i) {
    const peri__model *m = b->model;
    if (!b->alive) return 0;
    const uint32_t *alive = &b->alive[i * m->words];
    for (int32_t w = 0, left = m->count[i]; left > 0; ++w, left -= 32)
        if (alive[w] != (left >= 32 ? ~(uint32_t)0 : ((uint32_t)1 << left) - 1)) return 1;
    return 0;
}

/* Marks what lost its first bond, in mark[points]. 1: of these some have no row. */
static int peri__mark_exposed(const peri_body *b, uint8_t *mark) {
    int joined = 0;
    for (int64_t i = 0; i < b->model->points; ++i) {
        if ((mark[i] & PERI__EXPOSED) || !peri__lost_a_bond(b, i)) continue;
        mark[i] |= PERI__EXPOSED;
        joined = joined || !(mark[i] & PERI__MEMBER);
    }
    return joined;
}

static void peri__mark_neighbors(const peri_body *b, uint8_t *mark, int64_t i) {
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) mark[row.ids[k]] |= PERI__MEMBER;
}

/* sums->b: the largest volume of a family, its point included. */
static void peri__survey_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__survey *s = (const peri__survey *)context;
    const peri__model *m = s->body->model;
    for (int64_t i = begin; i < end; ++i) {
        peri__row row;
        peri__read_row(s->body, i, &row);
        s->seen[i] = m->volume[i];
        for (int64_t k = 0; k < row.count; ++k) s->seen[i] += m->volume[row.ids[k]];
        if (s->seen[i] > sums->b) sums->b = s->seen[i];
    }
}

/* Marks what a surface exposes: a point whose family has not nine tenths of the largest volume, or, in pieces smaller than the horizon
   where nobody has a whole one, not half of a ball. 0 where memory is short. */
static int peri__mark_surfaces(peri_body *b, uint8_t *mark) {
    const peri__model *m = b->model;
    double least = 0.5 * (m->dim == 2 ? 3.14159 : 4.18879 * m->horizon) * peri__square(m->horizon);
    peri__survey s;
    s.body = b;
    s.seen = (double *)peri__new(&b->scratch, m->points, sizeof *s.seen);
    if (!s.seen) return 0;
    peri__for_points(b, m->points, m->width, peri__survey_block, &s, b->sums);
    for (int64_t k = 0; k < m->blocks; ++k) least = fmax(least, 0.9 * b->sums[k].b);
    for (int64_t i = 0; i < m->points; ++i)
        if (s.seen[i] < least) mark[i] |= PERI__EXPOSED;
    peri__delete(&b->scratch, s.seen, m->points, sizeof *s.seen);
    return 1;
}

/* Marks the members; returns how many there are. What is exposed is marked. */
static int64_t peri__mark_members(const peri_body *b, uint8_t *mark) {
    const peri__model *m = b->model;
    int64_t members = 0;
    for (int64_t i = 0; i < m->points; ++i) {
        if (mark[i] & PERI__EXPOSED) mark[i] |= PERI__MEMBER;
        if (!(mark[i] & PERI__EXPOSED) || (mark[i] & PERI__SPREAD) || !peri__lost_a_bond(b, i)) continue;
        mark[i] |= PERI__SPREAD;
        peri__mark_neighbors(b, mark, i);
    }
    for (int64_t i = 0; i < m->points; ++i) members += (mark[i] & PERI__MEMBER) != 0;
    return members;
}

/* ---- the grid ------------------------------------------------------------------------------------------------------- */

PERI_INLINE int64_t peri__bucket_of(const peri__grid *g, const int64_t *cell) {
    const uint64_t mixed = (uint64_t)cell[0] * UINT64_C(0x9E3779B97F4A7C15) ^ (uint64_t)cell[1] * UINT64_C(0xC2B2AE3D27D4EB4F)
                         ^ (uint64_t)cell[2] * UINT64_C(0x165667B19E3779F9);
    return (int64_t)((mixed ^ mixed >> 29) & (uint64_t)(g->buckets - 1));
}

/* Notes the cell of member p, which is at place[3], components beyond the dimension 0. */
static void peri__put_in_cell(const peri__grid *g, int64_t p, const double *place) {
    int64_t *cell = &g->cell[3 * p];
    int lost = 0;
    for (int d = 0; d < 3; ++d) {
        const double at = place[d] / g->edge;
        cell[d] = 0;
        if (fabs(at) < 1e18) cell[d] = (int64_t)floor(at);
        else lost = 1; /* nor a number */
    }
    g->bucket[p] = lost ? -1 : (int32_t)peri__bucket_of(g, cell);
}

static void peri__cells_of_members(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__hunt *s = (const peri__hunt *)context;
    const peri_body *b = s->body;
    (void)sums;
    for (int64_t p = begin; p < end; ++p) {
        double place[3] = { 0.0, 0.0, 0.0 };
        for (int32_t d = 0; d < b->dim; ++d) {
            const int64_t at = d * b->model->stride + s->member[p];
            place[d] = peri__get_real(b->model->x, b->f32, at) + peri__get_real(b->u, b->f32, at);
        }
        peri__put_in_cell(&s->grid, p, place);
    }
}

/* Sorts the members, whose cells are noted. */
static void peri__sort_grid(const peri__grid *g) {
    for (int64_t p = 0; p < g->members; ++p)
        if (g->bucket[p] >= 0) g->start[g->bucket[p] + 1]++;
    for (int64_t k = 0; k < g->buckets; ++k) g->start[k + 1] += g->start[k];
    for (int64_t p = 0; p < g->members; ++p)
        if (g->bucket[p] >= 0) g->order[g->start[g->bucket[p]]++] = (int32_t)p;
    for (int64_t k = g->buckets; k > 0; --k) g->start[k] = g->start[k - 1];
    g->start[0] = 0;
}

/* The n-th of the 9, in space 27, cells at and about that of member p, and its bucket. */
PERI_INLINE int64_t peri__cell_about(const peri__grid *g, int64_t p, int64_t n, int deep, int64_t *cell) {
    cell[0] = g->cell[3 * p] + n % 3 - 1;
    cell[1] = g->cell[3 * p + 1] + n / 3 % 3 - 1;
    cell[2] = g->cell[3 * p + 2] + (deep ? n / 9 - 1 : 0);
    return peri__bucket_of(g, cell);
}

/* Room for g->members. 0 where memory is short. */
static int peri__take_grid(const peri__memory *memory, peri__grid *g) {
    for (g->buckets = 64; g->buckets < g->members; g->buckets *= 2) {}
    g->cell = (int64_t *)peri__new(memory, 3 * g->members, sizeof *g->cell);
    g->bucket = (int32_t *)peri__new(memory, g->members, sizeof *g->bucket);
    g->start = (int32_t *)peri__new(memory, g->buckets + 1, sizeof *g->start);
    g->order = (int32_t *)peri__new(memory, g->members, sizeof *g->order);
    return g->cell && g->bucket && g->start && g->order;
}

static void peri__drop_grid(const peri__memory *memory, peri__grid *g) {
    peri__delete(memory, g->order, g->members, sizeof *g->order);
    peri__delete(memory, g->start, g->buckets + 1, sizeof *g->start);
    peri__delete(memory, g->bucket, g->members, sizeof *g->bucket);
    peri__delete(memory, g->cell, 3 * g->members, sizeof *g->cell);
}

/* Members that may come to touch member p before the lists are made again, to other[], and the squares of their reach. Returns how many;
   both may be NULL. */
static int64_t peri__list_candidates(const peri__hunt *s, int64_t p, int32_t *other, double *reach2) {
    const peri_body *b = s->body;
    const int64_t i = s->member[p], deep = b->dim == 3;
    int64_t cell[3], found = 0;
    const peri__grid *g = &s->grid;
    if (g->bucket[p] < 0) return 0;
    for (int64_t n = 0; n < (deep ? 27 : 9); ++n) {
        const int64_t bucket = peri__cell_about(g, p, n, (int)deep, cell);
        for (int32_t k = g->start[bucket]; k < g->start[bucket + 1]; ++k) {
            const int64_t q = g->order[k], j = s->member[q];
            const int64_t *there = &g->cell[3 * q];
            double r[3];
            if (q == p || there[0] != cell[0] || there[1] != cell[1] || there[2] != cell[2]) continue;
            const peri__touch *touch = peri__touch_of(b, i, j);
            const double square = touch->on ? peri__between(b, i, j, r) : HUGE_VAL;
            if (!(square < peri__square(touch->distance + s->skin))) continue;
            const double least = peri__reach2(b, touch, i, j);
            if (!(square < peri__square(sqrt(least) + s->skin))) continue;
            if (other) other[found] = (int32_t)q;
            if (reach2) reach2[found] = least;
            found++;
        }
    }
    return found;
}

static void peri__count_candidates(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__hunt *s = (const peri__hunt *)context;
    (void)sums;
    for (int64_t p = begin; p < end; ++p) s->begin[p + 1] = peri__list_candidates(s, p, NULL, NULL);
}

/* ---- the lists ------------------------------------------------------------------------------------------------------ */

/* Puts entry `from` of a row before entry `to`, which lies before it. */
static void peri__put_before(const peri__contact *c, int64_t to, int64_t from) {
    const int32_t other = c->other[from], bond = c->bond[from];
    const double reach2 = c->reach2[from];
    for (; from > to; --from) {
        c->other[from] = c->other[from - 1];
        c->bond[from] = c->bond[from - 1];
        c->reach2[from] = c->reach2[from - 1];
    }
    c->other[to] = other;
    c->bond[to] = bond;
    c->reach2[to] = reach2;
}

/* Opens entry e of member p, which sleeps or has just been listed behind the open ones. */
static void peri__open_entry(const peri__contact *c, int64_t p, int64_t e) {
    int64_t to = c->begin[p] + c->open[p]++;
    while (to > c->begin[p] && c->other[to - 1] > c->other[e]) --to;
    peri__put_before(c, to, e);
}

static void peri__fill_lists(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__hunt *s = (const peri__hunt *)context;
    const peri_body *b = s->body;
    const peri__contact *c = s->contact;
    (void)sums;
    for (int64_t p = begin; p < end; ++p) {
        const int64_t first = c->begin[p], i = c->member[p];
        const int64_t found = peri__list_candidates(s, p, &c->other[first], &c->reach2[first]);
        for (int32_t d = 0; d < b->dim; ++d) c->at[p * b->dim + d] = peri__get_real(b->u, b->f32, d * b->model->stride + i);
        c->open[p] = 0;
        for (int64_t e = first; e < first + found; ++e) c->bond[e] = (int32_t)peri__find_bond(b->model, i, c->member[c->other[e]]);
        for (int64_t e = first; e < first + found; ++e)
            if (!peri__sleeps(b, i, c->member[c->other[e]], c->bond[e])) peri__open_entry(c, p, e);
    }
}

static int peri__take_hunt(peri__hunt *s) {
    const peri__memory *memory = &s->body->scratch;
    s->member = (int32_t *)peri__new(memory, s->grid.members, sizeof *s->member);
    s->begin = (int64_t *)peri__new(memory, s->grid.members + 1, sizeof *s->begin);
    return peri__take_grid(memory, &s->grid) && s->member && s->begin;
}

static void peri__drop_hunt(peri__hunt *s) {
    const peri__memory *memory = &s->body->scratch;
    peri__drop_grid(memory, &s->grid);
    peri__delete(memory, s->begin, s->grid.members + 1, sizeof *s->begin);
    peri__delete(memory, s->member, s->grid.members, sizeof *s->member);
}

/* Makes the lists anew. 0 where memory is short: the old ones stay. */
static int peri__search_contact(peri_body *b) {
    peri__contact *c = b->contact;
    peri__hunt s;
    int64_t at = 0;
    memset(&s, 0, sizeof s);
    s.body = b;
    s.contact = c;
    s.skin = PERI_SKIN * c->distance;
    s.grid.edge = 1.25 * (c->distance + s.skin); /* sums of places and displacements may be off by an eighth of a spacing */
    int ok = c->surveyed || peri__mark_surfaces(b, c->mark);
    c->surveyed = ok;
    if (ok) s.grid.members = peri__mark_members(b, c->mark);
    const int64_t members = s.grid.members;
    ok = ok && peri__take_hunt(&s);
    if (ok) {
        for (int64_t i = 0; i < b->model->points; ++i)
            if (c->mark[i] & PERI__MEMBER) s.member[at++] = (int32_t)i;
        peri__for_points(b, members, 2, peri__cells_of_members, &s, NULL);
        peri__sort_grid(&s.grid);
        peri__for_points(b, members, 20, peri__count_candidates, &s, NULL);
        for (int64_t p = 0; p < members; ++p) s.begin[p + 1] += s.begin[p];
        ok = peri__need_lists(b, c, members, s.begin[members]);
    }
    if (ok) {
        c->members = members;
        c->entries = s.begin[members];
        memcpy(c->member, s.member, (size_t)members * sizeof *s.member);
        memcpy(c->begin, s.begin, (size_t)(members + 1) * sizeof *s.begin);
        memset(c->touching, 0, (size_t)members * sizeof *c->touching);
        peri__for_points(b, members, 20, peri__fill_lists, &s, NULL);
        c->listed = 1;
    }
    peri__drop_hunt(&s);
    return ok;
}

/* sums->a: the square of the farthest that a member has moved since the lists were made. */
static void peri__moved_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = (const peri_body *)context;
    const peri__contact *c = b->contact;
    for (int64_t p = begin; p < end; ++p) {
        double square = 0.0;
        for (int32_t d = 0; d < b->dim; ++d)
            square += peri__square(peri__get_real(b->u, b->f32, d * b->model->stride + c->member[p]) - c->at[p * b->dim + d]);
        if (!(square <= sums->a)) sums->a = square;
    }
}

static int peri__has_moved(const peri_body *b) {
    const peri__contact *c = b->contact;
    const double most = 0.25 * peri__square(PERI_SKIN * c->distance);
    peri__for_points(b, c->members, 1, peri__moved_block, (void *)b, b->sums);
    for (int64_t k = 0; k * PERI_BLOCK < c->members; ++k)
        if (!(b->sums[k].a <= most)) return 1;
    return 0;
}
