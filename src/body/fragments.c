/* SPDX-License-Identifier: MIT */
/* fragments.c - points that are joined by live bonds: which there are, and what each of them is as a rigid body.

   Bonds only die, so a fragment can but split, and one that lost no bond is what it was. What is known is brought up to date where more
   bonds are dead than were when it was made: from every point that has lost one since, a region grows along live bonds, all of them side
   by side. Regions that meet become one; one that runs out is a piece of its own; where a single one is left in a fragment, that is the
   rest of it and is not gone through. So a crack that has cut nothing off costs some rings of points around its new part.

   Points are taken by groups of PERI_GROUP, a bit each, and live bonds by columns as the kernels have them: sixteen at a time; one thread
   does it all. The numbers do not depend on the order in which regions grow: the piece of most points, of equal ones that of the least
   point, stays what the fragment was; the others get the next numbers, by their least points. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_MIXED (-1) /* a group with reached points of several regions: they are in `owner`                            */

typedef struct peri__region {
    int32_t at;      /* the place that it began at                                                                        */
    int32_t up;      /* the region that it has become a part of, itself where it is whole                                 */
    int32_t waiting; /* points whose bonds are still to be followed                                                       */
    int32_t reached; /* points                                                                                            */
    int32_t done;    /* 1: it ran out, so that it is a piece                                                              */
    int32_t least;   /* of a piece: its least point, or -1 while that is sought                                           */
    int32_t number;  /* and the fragment that it becomes                                                                  */
    int32_t next;    /* and the piece of the next larger least point; -1: none                                            */
} peri__region;

typedef struct peri__split { /* of a fragment that is looked through                                                      */
    int32_t growing; /* regions in it that have not run out                                                               */
    int32_t lost;    /* points of those that have                                                                         */
    int32_t rest;    /* the region that is left, or -1 where it has not split                                             */
    int32_t keeper;  /* the piece that stays this fragment, likewise                                                      */
} peri__split;

typedef struct peri__known { /* that points of a group belong to a region                                                 */
    int32_t  region; /* -1: none                                                                                          */
    uint32_t lanes;  /* some of those that do                                                                             */
} peri__known;

typedef struct peri__flood { /* points by their places in the order of the rows; groups are of places                     */
    peri_body    *body;
    peri__split  *split;        /* [points], of which there is one for each fragment                                      */
    peri__region *region;       /* [points], of which there are `regions`, in the order in which they began               */
    int32_t      *owner;        /* [points] region of points of mixed groups                                              */
    int32_t      *place;        /* [points] of a point; NULL where that is its number                                     */
    int32_t      *group_region; /* [groups] region of all its reached points, or PERI_MIXED                               */
    int32_t      *queue;        /* [groups] a ring: those with fresh points                                               */
    uint16_t     *reached;      /* [groups] points that some region has; and those of them whose bonds are to be followed */
    uint16_t     *fresh;
    peri__known  *known;        /* [groups][2] the last two regions that came to a group                                  */
    int64_t       groups, head, queued;
    int64_t       open;         /* fragments with more than one region that may still grow                                */
    int32_t       regions;
    int32_t       begun, last;  /* the list of pieces                                                                     */
} peri__flood;

static int64_t peri__flood_bytes(const peri__model *m, int64_t groups) {
    return m->points * (int64_t)(sizeof(peri__split) + sizeof(peri__region) + 2 * sizeof(int32_t))
         + groups * (int64_t)(2 * (sizeof(peri__known) + sizeof(int32_t) + sizeof(uint16_t)));
}

/* 0 where memory is short. */
static int peri__open_flood(peri_body *b, peri__flood *s) {
    const peri__model *m = b->model;
    memset(s, 0, sizeof *s);
    s->groups = (m->points + PERI_GROUP - 1) / PERI_GROUP;
    s->split = (peri__split *)peri__new_unset(&b->scratch, peri__flood_bytes(m, s->groups), 1);
    if (!s->split) return 0;
    s->body = b;
    s->region = (peri__region *)(s->split + m->points);
    s->owner = (int32_t *)(s->region + m->points);
    s->group_region = s->owner + 2 * m->points;
    s->queue = s->group_region + s->groups;
    s->known = (peri__known *)(s->queue + s->groups);
    s->reached = (uint16_t *)(s->known + 2 * s->groups);
    s->fresh = s->reached + s->groups;
    s->begun = s->last = -1;
    for (int64_t k = 0; k < 2 * s->groups; ++k) s->known[k].region = -1;
    memset(s->reached, 0, (size_t)(2 * s->groups) * sizeof *s->reached);
    if (m->order) s->place = s->owner + m->points;
    for (int64_t at = 0; m->order && at < m->points; ++at) s->place[m->order[at]] = (int32_t)at;
    return 1;
}

static void peri__close_flood(peri__flood *s) {
    peri__delete(&s->body->scratch, s->split, peri__flood_bytes(s->body->model, s->groups), 1);
}

static int64_t peri__flood_place(const peri__flood *s, int64_t i) { return s->place ? s->place[i] : i; }

static int32_t peri__count_lanes(uint32_t bits) {
    bits = (bits & 0x5555u) + (bits >> 1 & 0x5555u);
    bits = (bits & 0x3333u) + (bits >> 2 & 0x3333u);
    bits = (bits & 0x0F0Fu) + (bits >> 4 & 0x0F0Fu);
    return (int32_t)((bits & 0xFFu) + (bits >> 8));
}

static int32_t peri__least_lane(uint32_t bits) { return peri__count_lanes((bits & (0u - bits)) - 1u); }

/* The region that r has become a part of. */
static int32_t peri__whole_region(const peri__flood *s, int32_t r) {
    while (s->region[r].up != r) r = s->region[r].up = s->region[s->region[r].up].up;
    return r;
}

static int32_t peri__region_at(const peri__flood *s, int64_t at) {
    const int32_t r = s->group_region[at / PERI_GROUP];
    return peri__whole_region(s, r == PERI_MIXED ? s->owner[at] : r);
}

static int peri__is_reached(const peri__flood *s, int64_t at) { return s->reached[at / PERI_GROUP] >> (at % PERI_GROUP) & 1; }

static peri__split *peri__split_at(const peri__flood *s, int64_t at) {
    return &s->split[s->body->fragment_of[peri__nth(s->body->model, at)]];
}

/* Fragments that have not split, as far as is known. */
static void peri__clear_splits(peri__flood *s, int64_t count) {
    for (int64_t f = 0; f < count; ++f) {
        s->split[f].growing = s->split[f].lost = 0;
        s->split[f].rest = s->split[f].keeper = -1;
    }
}

/* One region more, or one less, of the fragment that r is in may still grow. */
static void peri__count_growing(peri__flood *s, int32_t r, int32_t change) {
    peri__split *split = peri__split_at(s, s->region[r].at);
    const int before = split->growing > 1;
    split->growing += change;
    s->open += (split->growing > 1) - before;
}

static int32_t peri__unite(peri__flood *s, int32_t p, int32_t q) {
    if (p == q) return p;
    const int32_t low = p < q ? p : q, high = p < q ? q : p;
    s->region[high].up = low;
    s->region[low].waiting += s->region[high].waiting;
    s->region[low].reached += s->region[high].reached;
    peri__count_growing(s, low, -1);
    return low;
}

/* Points of group g belong to r, which is whole. */
static void peri__know(peri__flood *s, int64_t g, uint32_t bits, int32_t r) {
    peri__known *known = &s->known[2 * g];
    if (known[0].region != r) { /* the other one, or the older one goes */
        const peri__known other = known[0];
        known[0] = known[1];
        known[1] = other;
    }
    known[0].lanes = known[0].region == r ? known[0].lanes | bits : bits;
    known[0].region = r;
}

/* Those of the points that are not known to belong to r. */
PERI_INLINE uint32_t peri__unknown(const peri__flood *s, int64_t g, uint32_t bits, int32_t r) {
    const peri__known *known = &s->known[2 * g];
    return bits & ~(known[0].region == r ? known[0].lanes : known[1].region == r ? known[1].lanes : 0u);
}

/* Points of group g that no region has become those of r, which is whole. */
static void peri__claim(peri__flood *s, int64_t g, uint32_t bits, int32_t r) {
    const int32_t former = s->group_region[g];
    if (!s->reached[g]) s->group_region[g] = r;
    else if (former != PERI_MIXED && peri__whole_region(s, former) != r) {
        for (uint32_t known = s->reached[g]; known; known &= known - 1u) s->owner[g * PERI_GROUP + peri__least_lane(known)] = former;
        s->group_region[g] = PERI_MIXED;
    }
    for (uint32_t left = bits; left && s->group_region[g] == PERI_MIXED; left &= left - 1u)
        s->owner[g * PERI_GROUP + peri__least_lane(left)] = r;
    s->reached[g] = (uint16_t)(s->reached[g] | bits);
    s->region[r].reached += peri__count_lanes(bits);
    peri__know(s, g, bits, r);
}

/* The bonds of these points are to be followed. */
static void peri__await(peri__flood *s, int64_t g, uint32_t bits, int32_t r) {
    if (!s->fresh[g]) s->queue[(s->head + s->queued++) % s->groups] = (int32_t)g;
    s->fresh[g] = (uint16_t)(s->fresh[g] | bits);
    s->region[r].waiting += peri__count_lanes(bits);
}

/* The points of a group that are joined to `bits` by bonds within it; of the list none. A bond is in two columns: one of them tells. */
static uint32_t peri__join_lanes(const peri__flood *s, int64_t g, uint32_t bits) {
    const peri__stencil *l = &s->body->model->stencil;
    if (!l->columns) return bits;
    const peri__column *column = &l->column[l->first[g]];
    const uint16_t *mask = s->body->masks ? &s->body->masks[l->begin[g]] : NULL;
    const int64_t count = l->begin[g + 1] - l->begin[g];
    int64_t c = 0, beyond = count; /* the first of positive offset */
    while (c < beyond) {
        const int64_t middle = (c + beyond) / 2;
        if (column[middle].offset > 0) beyond = middle;
        else c = middle + 1;
    }
    for (uint32_t former = 0; former != bits;) {
        former = bits;
        for (int64_t k = c; k < count && column[k].offset < PERI_GROUP; ++k) {
            const uint32_t live = mask ? mask[k] : column[k].member;
            bits |= ((bits & live) << column[k].offset & 0xFFFFu) | (bits >> column[k].offset & live);
        }
    }
    return bits;
}

/* Region r comes to points of group g by bonds, and so to what is joined to them within the group. Returns what r is then a part of. */
static int32_t peri__come_to(peri__flood *s, int64_t g, uint32_t bits, int32_t r) {
    const uint32_t fresh = bits & ~(uint32_t)s->reached[g], met = bits & s->reached[g];
    for (uint32_t left = peri__unknown(s, g, met, r); left; left &= left - 1u) {
        const int64_t at = g * PERI_GROUP + peri__least_lane(left);
        r = peri__unite(s, r, peri__region_at(s, at));
        if (s->group_region[g] != PERI_MIXED) {
            s->group_region[g] = r;
            break; /* all of them belong to one */
        }
        s->owner[at] = r;
    }
    if (met) peri__know(s, g, s->group_region[g] == PERI_MIXED ? met : s->reached[g], r);
    if (!fresh) return r;
    const uint32_t joined = peri__join_lanes(s, g, fresh) & ~(uint32_t)s->reached[g];
    peri__claim(s, g, joined, r);
    peri__await(s, g, joined, r);
    return r;
}

/* Follows the live bonds of the points `bits` of group g, by columns; then by the list. */
static int32_t peri__follow_columns(peri__flood *s, int64_t g, uint32_t bits, int32_t r) {
    const peri__model *m = s->body->model;
    const peri__stencil *l = &m->stencil;
    const peri__column *column = &l->column[l->first[g]];
    const uint16_t *mask = s->body->masks ? &s->body->masks[l->begin[g]] : NULL;
    const int64_t count = l->begin[g + 1] - l->begin[g], shift = m->margin / PERI_GROUP;
    for (int64_t c = 0; c < count; ++c) {
        const uint32_t live = (mask ? mask[c] : column[c].member) & bits;
        if (!live) continue;
        const uint64_t to = (uint64_t)(g * PERI_GROUP + column[c].offset + m->margin); /* of lane 0; the margin keeps it above 0 */
        const uint32_t both = live << (to % PERI_GROUP), low = both & 0xFFFFu, high = both >> PERI_GROUP;
        const int64_t group = (int64_t)(to / PERI_GROUP) - shift;
        if (low && peri__unknown(s, group, low, r)) r = peri__come_to(s, group, low, r);
        if (high && peri__unknown(s, group + 1, high, r)) r = peri__come_to(s, group + 1, high, r);
    }
    return r;
}

static int32_t peri__follow_row(peri__flood *s, int64_t at, int32_t r) {
    const peri__model *m = s->body->model;
    const int64_t i = peri__nth(m, at);
    const uint32_t *alive = s->body->alive ? &s->body->alive[i * m->words] : NULL;
    const int32_t *ids = &m->ids[m->start[i]], count = m->count[i];
    int64_t group = 0;
    uint32_t bits = 0; /* live neighbours in the group; ids ascend */
    for (int32_t k = 0; k < count; ++k) {
        const uint32_t id = (uint32_t)ids[k], flag = alive ? alive[k / 32] >> (k % 32) & 1u : 1u;
        if (group != id / PERI_GROUP) {
            if (peri__unknown(s, group, bits, r)) r = peri__come_to(s, group, bits, r);
            group = id / PERI_GROUP;
            bits = 0;
        }
        bits |= flag << (id % PERI_GROUP);
    }
    return peri__unknown(s, group, bits, r) ? peri__come_to(s, group, bits, r) : r;
}

static int32_t peri__follow_bonds(peri__flood *s, int64_t g, uint32_t bits, int32_t r) {
    if (s->body->model->stencil.columns) return peri__follow_columns(s, g, bits, r);
    for (; bits; bits &= bits - 1u) r = peri__follow_row(s, g * PERI_GROUP + peri__least_lane(bits), r);
    return r;
}

/* Regions of a mixed group may have become one: then it need not be mixed. */
static void peri__settle_group(peri__flood *s, int64_t g, int32_t r) {
    for (uint32_t left = s->reached[g]; left; left &= left - 1u)
        if (peri__region_at(s, g * PERI_GROUP + peri__least_lane(left)) != r) return;
    s->group_region[g] = r;
}

/* Follows the bonds of the group that comes next in the queue, region by region. */
static void peri__take_group(peri__flood *s) {
    const int64_t g = s->queue[s->head];
    uint32_t bits = s->fresh[g];
    s->fresh[g] = 0;
    s->head = (s->head + 1) % s->groups;
    s->queued--;
    while (bits) {
        const int64_t first = g * PERI_GROUP + peri__least_lane(bits);
        int32_t r = peri__region_at(s, first);
        uint32_t own = bits;
        if (s->group_region[g] == PERI_MIXED) peri__settle_group(s, g, r);
        for (uint32_t left = bits; s->group_region[g] == PERI_MIXED && left; left &= left - 1u)
            if (peri__region_at(s, g * PERI_GROUP + peri__least_lane(left)) != r) own &= ~(left & (0u - left));
        bits &= ~own;
        s->region[r].waiting -= peri__count_lanes(own);
        if (peri__split_at(s, first)->growing < 2) continue; /* the rest of its fragment */
        r = peri__follow_bonds(s, g, own, r);
        if (s->region[r].waiting > 0) continue;
        s->region[r].done = 1;
        peri__count_growing(s, r, -1);
    }
}

/* A region begins at a place, and what is joined to it within its group. */
static void peri__begin_region(peri__flood *s, int64_t at) {
    const uint32_t bits = peri__join_lanes(s, at / PERI_GROUP, (uint32_t)1 << (at % PERI_GROUP)) & ~(uint32_t)s->reached[at / PERI_GROUP];
    const int32_t r = s->regions++;
    memset(&s->region[r], 0, sizeof s->region[r]);
    s->region[r].at = (int32_t)at;
    s->region[r].up = r;
    s->region[r].least = -1;
    peri__count_growing(s, r, 1);
    peri__claim(s, at / PERI_GROUP, bits, r);
    peri__await(s, at / PERI_GROUP, bits, r);
}

/* ---- numbers ------------------------------------------------------------------------------------------------------ */

static void peri__set_fragment(peri_body *b, int64_t f, const peri__region *piece, int32_t parent) {
    b->fragments[f].first = piece->least;
    b->fragments[f].points = piece->reached;
    b->fragments[f].parent = parent;
}

static void peri__append_region(peri__flood *s, int32_t r) {
    if (s->last < 0) s->begun = r;
    else s->region[s->last].next = r;
    s->region[r].next = -1;
    s->last = r;
}

/* Which piece each point of a split fragment is in, to owner[place]; and the list of the pieces. */
static void peri__list_pieces(peri__flood *s) {
    const peri_body *b = s->body;
    int32_t last = -1, whole = -1;
    s->begun = s->last = -1;
    for (int64_t i = 0; i < b->model->points; ++i) {
        int32_t piece = s->split[b->fragment_of[i]].rest;
        if (piece < 0) continue;
        const int64_t at = peri__flood_place(s, i);
        if (peri__is_reached(s, at)) {
            const int32_t raw = s->group_region[at / PERI_GROUP] == PERI_MIXED ? s->owner[at] : s->group_region[at / PERI_GROUP];
            if (raw != last) whole = peri__whole_region(s, last = raw);
            if (s->region[whole].done) piece = whole;
        }
        s->owner[at] = piece;
        if (s->region[piece].least >= 0) continue;
        s->region[piece].least = (int32_t)i;
        peri__append_region(s, piece);
    }
}

/* All of the body anew, as pieces of one. */
static void peri__number_all(peri__flood *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    memset(b->fragment_of, 0, (size_t)m->points * sizeof *b->fragment_of);
    peri__clear_splits(s, 1);
    s->split[0].growing = 2; /* beside the one that grows, so that none is taken for a rest */
    s->split[0].rest = 0;
    for (int64_t at = 0; at < m->points; ++at) {
        if (peri__is_reached(s, at)) continue;
        peri__begin_region(s, at);
        while (s->queued > 0) peri__take_group(s);
    }
    peri__list_pieces(s);
    for (int32_t r = s->begun; r >= 0; r = s->region[r].next) {
        s->region[r].number = (int32_t)b->now.fragments++;
        peri__set_fragment(b, s->region[r].number, &s->region[r], -1);
    }
    for (int64_t i = 0; i < m->points; ++i) b->fragment_of[i] = s->region[s->owner[peri__flood_place(s, i)]].number;
}

/* Begins regions where points have lost a bond since. */
static void peri__begin_at_losses(peri__flood *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int64_t block = 0; block < m->blocks; ++block) {
        const int64_t begin = block * PERI_BLOCK, end = peri__min(begin + PERI_BLOCK, m->points);
        const uint32_t *known = &b->fragment_alive[begin * m->words], *alive = &b->alive[begin * m->words];
        if (memcmp(known, alive, (size_t)((end - begin) * m->words) * sizeof *known) == 0) continue;
        for (int64_t i = begin; i < end; ++i, known += m->words, alive += m->words) {
            uint32_t lost = 0;
            for (int32_t word = 0; word < m->words; ++word) lost |= known[word] ^ alive[word];
            if (lost && !peri__is_reached(s, peri__flood_place(s, i))) peri__begin_region(s, peri__flood_place(s, i));
        }
    }
}

/* Notes of every fragment that split which region stands for its rest, and how many points that has. */
static void peri__find_rests(peri__flood *s) {
    for (int pass = 0; pass < 2; ++pass) /* which have split, then their rests */
        for (int32_t r = 0; r < s->regions; ++r) {
            if (s->region[r].up != r) continue;
            peri__split *split = peri__split_at(s, s->region[r].at);
            if (pass == 0 && s->region[r].done) split->lost += s->region[r].reached;
            else if (pass == 1 && split->lost > 0 && !s->region[r].done) {
                split->rest = r;
                s->region[r].reached = s->body->fragments[split - s->split].points - split->lost;
            }
        }
}

static void peri__number_pieces(peri__flood *s) {
    peri_body *b = s->body;
    const int64_t former = b->now.fragments;
    for (int32_t r = s->begun; r >= 0; r = s->region[r].next) {
        peri__split *split = peri__split_at(s, s->region[r].at);
        if (split->keeper < 0 || s->region[r].reached > s->region[split->keeper].reached) split->keeper = r;
    }
    for (int32_t r = s->begun; r >= 0; r = s->region[r].next) {
        const int32_t from = (int32_t)(peri__split_at(s, s->region[r].at) - s->split), keeps = s->split[from].keeper == r;
        s->region[r].number = keeps ? from : (int32_t)b->now.fragments++;
        if (!keeps) peri__set_fragment(b, s->region[r].number, &s->region[r], from);
    }
    for (int64_t i = 0; i < b->model->points; ++i)
        if (s->split[b->fragment_of[i]].keeper >= 0) b->fragment_of[i] = s->region[s->owner[peri__flood_place(s, i)]].number;
    for (int64_t f = 0; f < former; ++f)
        if (s->split[f].keeper >= 0) peri__set_fragment(b, f, &s->region[s->split[f].keeper], b->fragments[f].parent);
}

/* Of a body whose bonds have died since. */
static void peri__number_splits(peri__flood *s) {
    peri__clear_splits(s, s->body->now.fragments);
    peri__begin_at_losses(s);
    while (s->queued > 0 && s->open > 0) peri__take_group(s);
    peri__find_rests(s);
    for (int64_t f = 0; f < s->body->now.fragments; ++f)
        if (s->split[f].rest >= 0) {
            peri__list_pieces(s);
            peri__number_pieces(s);
            return;
        }
}

static void peri__drop_fragments(peri_body *b) {
    const int64_t points = b->model->points;
    peri__delete(&b->memory, b->fragment_of, points, sizeof *b->fragment_of);
    peri__delete(&b->memory, b->fragments, points, sizeof *b->fragments);
    peri__delete(&b->memory, b->fragment_alive, points * b->model->words, sizeof *b->fragment_alive);
    b->fragment_of = NULL;
    b->fragments = NULL;
    b->fragment_alive = NULL;
    b->now.fragments = 0;
}

/* After a call that is refused, or that is no look: what was not known before it is not known after it. */
static void peri__forget_fragments(peri_body *b, int known) {
    if (!known) peri__drop_fragments(b);
}

/* 0 where memory is short: nothing is taken then. */
static int peri__need_fragments(peri_body *b) {
    const int64_t points = b->model->points;
    if (b->fragment_of) return 1;
    b->fragment_of = (int32_t *)peri__new_unset(&b->memory, points, sizeof *b->fragment_of);
    b->fragments = (peri__fragment *)peri__new(&b->memory, points, sizeof *b->fragments);
    b->fragment_alive = peri__new_flags(b);
    if (b->fragment_of && b->fragments && b->fragment_alive) return 1;
    peri__drop_fragments(b);
    return 0;
}

/* Brings the fragments up to date. */
static int32_t peri__label_fragments(peri_body *b) {
    const int64_t dead = b->now.cut + b->now.broken;
    peri__flood flood;
    PERI_NEED_WHOLE(b, "peri_find_fragments");
    if (b->now.fragments > 0 && b->now.fragment_dead == dead) return PERI_OK;
    if (!peri__open_flood(b, &flood)) return peri__fail(b, PERI_ERROR_MEMORY, "fragment", -1, 0.0);
    const int ok = peri__need_fragments(b);
    if (ok) {
        peri__update_masks(b);
        if (b->now.fragments > 0) peri__number_splits(&flood);
        else peri__number_all(&flood);
        if (b->alive) memcpy(b->fragment_alive, b->alive, (size_t)(b->model->points * b->model->words) * sizeof *b->alive);
        b->now.fragment_dead = dead;
    }
    peri__close_flood(&flood);
    return ok ? PERI_OK : peri__fail(b, PERI_ERROR_MEMORY, "fragment", -1, 0.0);
}

/* ---- what they are ------------------------------------------------------------------------------------------------ */

PERI_API int64_t peri_find_fragments(peri_body *b, int32_t *of_point, int64_t capacity) {
    PERI_NEED_BUILT(b);
    PERI_NEED(b, of_point || capacity == 0, "of_point");
    const int64_t points = b->model->points;
    if (of_point && capacity < points) return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)points);
    const int32_t status = peri__label_fragments(b);
    if (status < 0) return status;
    if (of_point) memcpy(of_point, b->fragment_of, (size_t)points * sizeof *of_point);
    return b->now.fragments;
}

/* Component d of the present place, and of the velocity, of a point; inner units. */
static void peri__motion_of(const peri_body *b, int64_t i, double *place, double *velocity) {
    const peri__model *m = b->model;
    place[2] = velocity[2] = 0.0;
    for (int32_t d = 0; d < m->dim; ++d) {
        const int64_t at = d * m->stride + i;
        place[d] = peri__get_real(m->x, b->f32, at) + peri__get_real(b->u, b->f32, at);
        velocity[d] = peri__get_real(b->v, b->f32, at);
    }
}

static void peri__add_mass(const peri_body *b, int64_t i, peri_fragment *fragment) {
    const double mass = peri__mass(b, i);
    const int first = !(fragment->mass > 0.0);
    double place[3], velocity[3];
    peri__motion_of(b, i, place, velocity);
    for (int32_t d = 0; d < b->dim; ++d) {
        if (first || place[d] < fragment->lo[d]) fragment->lo[d] = place[d];
        if (first || place[d] > fragment->hi[d]) fragment->hi[d] = place[d];
        fragment->centre[d] += mass * place[d];
        fragment->velocity[d] += mass * velocity[d];
    }
    fragment->mass += mass;
}

/* What a point adds about the centre. */
static void peri__add_spin(const peri_body *b, int64_t i, peri_fragment *fragment) {
    const double mass = peri__mass(b, i);
    double arm[3], velocity[3], turn[3];
    peri__motion_of(b, i, arm, velocity);
    for (int32_t d = 0; d < b->dim; ++d) {
        arm[d] -= fragment->centre[d];
        velocity[d] -= fragment->velocity[d];
    }
    peri__cross(arm, velocity, turn);
    const double square = peri__dot(arm, arm, 3);
    for (int d = 0; d < 3; ++d) {
        fragment->angular[d] += mass * turn[d];
        fragment->inertia[d] += mass * (square - arm[d] * arm[d]);
        fragment->inertia[3 + d] -= mass * arm[d] * arm[d < 2 ? d + 1 : 0]; /* xy yz xz */
    }
}

static void peri__scale_fragment(const peri_body *b, peri_fragment *fragment) {
    const peri__model *m = b->model;
    const double mass = m->density * pow(m->length, m->dim) * (m->dim == 3 ? 1.0 : b->desc.thickness), speed = peri__velocity_unit(m);
    fragment->mass *= mass;
    for (int32_t d = 0; d < 3; ++d) {
        fragment->angular[d] *= mass * m->length * speed;
        fragment->velocity[d] *= speed;
        if (d >= m->dim) continue;
        fragment->centre[d] = m->origin[d] + m->length * fragment->centre[d];
        fragment->lo[d] = m->origin[d] + m->length * fragment->lo[d];
        fragment->hi[d] = m->origin[d] + m->length * fragment->hi[d];
    }
    for (int k = 0; k < 6; ++k) fragment->inertia[k] *= mass * m->length * m->length;
}

PERI_API int32_t peri_get_fragments(peri_body *b, peri_fragment *out, int64_t capacity) {
    PERI_NEED_BUILT(b);
    PERI_NEED(b, out, "out");
    const peri__model *m = b->model;
    const int known = b->fragment_of != NULL;
    const int32_t status = peri__label_fragments(b);
    if (status < 0) return status;
    const int64_t count = b->now.fragments;
    if (capacity < count) {
        peri__forget_fragments(b, known);
        return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)count);
    }
    memset(out, 0, (size_t)count * sizeof *out);
    for (int64_t f = 0; f < count; ++f) {
        out[f].first = b->fragments[f].first;
        out[f].points = b->fragments[f].points;
        out[f].parent = b->fragments[f].parent;
    }
    for (int64_t i = 0; i < m->points; ++i) peri__add_mass(b, i, &out[b->fragment_of[i]]);
    for (int64_t f = 0; f < count; ++f)
        for (int d = 0; d < 3; ++d) {
            out[f].centre[d] /= out[f].mass;
            out[f].velocity[d] /= out[f].mass;
        }
    for (int64_t i = 0; i < m->points; ++i) peri__add_spin(b, i, &out[b->fragment_of[i]]);
    for (int64_t s = 0; s < b->load_count; ++s)
        for (int64_t k = 0; b->loads[s].owned && k < b->loads[s].count; ++k)
            if (b->loads[s].owned[k]) out[b->fragment_of[peri__set_point(b, b->loads[s].set, k)]].held = 1;
    for (int64_t f = 0; f < count; ++f) peri__scale_fragment(b, &out[f]);
    return PERI_OK;
}
