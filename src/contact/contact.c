/* SPDX-License-Identifier: MIT */
/* contact.c - what a body keeps of its contact: what is declared of each pair of materials, and lists of points that may touch. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__touch { /* contact of two materials, inner units                                                       */
    int32_t on;
    double  distance;
    double  stiffness;      /* of the spring between two points, over the harmonic mean of their volumes                      */
    double  friction, friction_speed;
    double  loss;           /* B of force.c: the largest part of the spring's force that the dashpot may have                */
    peri_contact_desc desc; /* as given                                                                                      */
} peri__touch;

typedef enum peri__exposure { /* of a point, or-ed                                                                              */
    PERI__EXPOSED = 1, /* it may touch: a surface or a lost bond                                                             */
    PERI__MEMBER = 2,  /* it has a row                                                                                       */
    PERI__SPREAD = 4   /* it lost a bond, and its neighbours are members for that                                            */
} peri__exposure;

struct peri__contact {
    peri__touch *touch;    /* [materials][materials]                                                                        */
    double   distance;     /* the largest                                                                                    */
    double   bound, crowd; /* of the row sums of contact over rho: as assumed of any state, and as found in the last pass     */
    double   hold;         /* bounds what dashpots and friction do to the velocity of a point per time; 0: there are none      */
    double   growth;       /* what dashpots may make of the stiffness                                                         */
    uint8_t *mark;         /* [points] bits of peri__exposure                                                                    */
    double  *drag;         /* [dim][stride] force density of dashpots and friction in the last step; NULL where there are none */
    int32_t  surveyed;     /* 1: points at surfaces are marked                                                              */
    int32_t  listed;       /* 1: the lists hold, for the bonds up to `dead`                                                  */
    int64_t  dead;         /* broken and cut bonds then; -1: look                                                            */
    int64_t  members, member_capacity, entries, entry_capacity;
    int32_t *member;       /* [members] points, ascending                                                                   */
    double  *at;           /* [members][dim] displacement when the lists were made                                           */
    int64_t *begin;        /* [members+1] row of a member among the entries                                                  */
    int32_t *open;         /* [members] entries of the row that do not sleep                                                 */
    int32_t *touching;     /* [members] points that the member touches, in the last pass                                     */
    int32_t *other;        /* [entries] members, ascending among the open and among the sleeping                             */
    int32_t *bond;         /* [entries] bond of the row of families; -1: none                                                */
    double  *reach2;       /* [entries] square of the distance at which they touch                                           */
};

/* ---- memory ---------------------------------------------------------------------------------------------------------- */

/* The arrays of a contact that grow with its members, and with its entries; `rest`: items more than members. */
typedef struct peri__grown {
    size_t  place, size;
    int64_t per, rest;
    int     entries;
} peri__grown;
#define PERI_GROWN 8

static void peri__list_grown(int32_t dim, peri__grown *list) {
    const peri__grown arrays[PERI_GROWN] = {
        { offsetof(peri__contact, member), sizeof(int32_t), 1, 0, 0 },
        { offsetof(peri__contact, at), sizeof(double), dim, 0, 0 },
        { offsetof(peri__contact, begin), sizeof(int64_t), 1, 1, 0 },
        { offsetof(peri__contact, open), sizeof(int32_t), 1, 0, 0 },
        { offsetof(peri__contact, touching), sizeof(int32_t), 1, 0, 0 },
        { offsetof(peri__contact, other), sizeof(int32_t), 1, 0, 1 },
        { offsetof(peri__contact, bond), sizeof(int32_t), 1, 0, 1 },
        { offsetof(peri__contact, reach2), sizeof(double), 1, 0, 1 },
    };
    memcpy(list, arrays, sizeof arrays);
}

static void *peri__grown_at(const void *c, size_t place) {
    void *pointer;
    memcpy(&pointer, (const char *)c + place, sizeof pointer);
    return pointer;
}

static int64_t peri__grown_count(const peri__grown *array, int64_t members, int64_t entries) {
    return array->per * (array->entries ? entries : members) + array->rest;
}

static void peri__drop_lists(const peri_body *b, peri__contact *c) {
    peri__grown arrays[PERI_GROWN];
    const void *none = NULL;
    peri__list_grown(b->dim, arrays);
    for (int k = 0; k < PERI_GROWN; ++k) {
        peri__delete(&b->memory, peri__grown_at(c, arrays[k].place), peri__grown_count(&arrays[k], c->member_capacity, c->entry_capacity),
                     arrays[k].size);
        memcpy((char *)c + arrays[k].place, &none, sizeof none);
    }
    c->member_capacity = c->entry_capacity = c->members = c->entries = 0;
    c->listed = 0;
}

/* Room for the lists, old ones dropped only where there is room for the new ones. 0 where memory is short. */
static int peri__need_lists(const peri_body *b, peri__contact *c, int64_t members, int64_t entries) {
    peri__grown arrays[PERI_GROWN];
    void *made[PERI_GROWN];
    int ok = 1;
    if (c->member && members <= c->member_capacity && entries <= c->entry_capacity) return 1;
    members += members / 4; /* a crack that grows asks again and again */
    entries += entries / 4;
    peri__list_grown(b->dim, arrays);
    for (int k = 0; k < PERI_GROWN; ++k) {
        made[k] = ok ? peri__new(&b->memory, peri__grown_count(&arrays[k], members, entries), arrays[k].size) : NULL;
        ok = ok && made[k];
    }
    if (ok) peri__drop_lists(b, c);
    for (int k = 0; k < PERI_GROWN; ++k) {
        if (ok) memcpy((char *)c + arrays[k].place, &made[k], sizeof made[k]);
        else peri__delete(&b->memory, made[k], peri__grown_count(&arrays[k], members, entries), arrays[k].size);
    }
    if (!ok) return 0;
    c->member_capacity = members;
    c->entry_capacity = entries;
    return 1;
}

static peri__contact *peri__new_contact(const peri_body *b) {
    const peri__model *m = b->model;
    peri__contact *c = (peri__contact *)peri__new(&b->memory, 1, sizeof *c);
    if (!c) return NULL;
    c->touch = (peri__touch *)peri__new(&b->memory, (int64_t)m->materials * m->materials, sizeof *c->touch);
    c->mark = (uint8_t *)peri__new(&b->memory, m->points, 1);
    c->dead = -1;
    return c;
}

static double *peri__new_drag(const peri_body *b) {
    return (double *)peri__new(&b->memory, b->model->stride * b->model->dim, sizeof(double));
}

static void peri__free_contact(const peri_body *b, peri__contact *c) {
    const peri__model *m = b->model;
    if (!c) return;
    peri__drop_lists(b, c);
    peri__delete(&b->memory, c->touch, (int64_t)m->materials * m->materials, sizeof *c->touch);
    peri__delete(&b->memory, c->mark, m->points, 1);
    peri__delete(&b->memory, c->drag, m->stride * m->dim, sizeof *c->drag);
    peri__delete(&b->memory, c, 1, sizeof *c);
}

/* What `from` declares, and what resisted in its last step; the lists are made when needed. NULL where memory is short. */
static peri__contact *peri__copy_contact(const peri_body *b, const peri__contact *from) {
    const peri__model *m = b->model;
    peri__contact *c = peri__new_contact(b);
    int ok = c && c->touch && c->mark;
    if (ok && from->drag) ok = (c->drag = peri__new_drag(b)) != NULL;
    if (!ok) {
        peri__free_contact(b, c);
        return NULL;
    }
    memcpy(c->touch, from->touch, (size_t)(m->materials * m->materials) * sizeof *c->touch);
    if (c->drag) memcpy(c->drag, from->drag, (size_t)(m->stride * m->dim) * sizeof *c->drag);
    c->distance = from->distance;
    c->bound = from->bound;
    c->crowd = from->crowd;
    c->hold = from->hold;
    c->growth = from->growth;
    return c;
}

/* What it holds. */
static int64_t peri__contact_bytes(const peri_body *b) {
    const peri__contact *c = b->contact;
    const peri__model *m = b->model;
    peri__grown arrays[PERI_GROWN];
    if (!c) return 0;
    uint64_t bytes = peri__block_bytes(1, sizeof *c) + peri__block_bytes(m->points, 1);
    bytes += peri__block_bytes((int64_t)m->materials * m->materials, sizeof *c->touch);
    if (c->drag) bytes += peri__block_bytes(m->stride * m->dim, sizeof *c->drag);
    peri__list_grown(b->dim, arrays);
    for (int k = 0; c->member && k < PERI_GROWN; ++k)
        bytes += peri__block_bytes(peri__grown_count(&arrays[k], c->member_capacity, c->entry_capacity), arrays[k].size);
    return (int64_t)bytes;
}

/* Every bond is looked at again, and the lists are made anew. */
static void peri__forget_contact(peri__contact *c, const peri__model *m) {
    if (!c) return;
    c->listed = c->surveyed = 0;
    c->dead = -1;
    c->crowd = 0.0;
    memset(c->mark, 0, (size_t)m->points);
    if (c->drag) memset(c->drag, 0, (size_t)(m->stride * m->dim) * sizeof *c->drag);
}
