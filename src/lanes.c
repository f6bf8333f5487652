/* lanes.c - Ibond compressed, for points that come from a lattice.

   Rows are taken in groups of PERI_LANES. On a lattice the bonds of a group along one lattice vector lead from each point to "own id +
   offset" with one offset, so a column of them is that offset, one row of a small table of bond vectors, and a mask that says which of the
   points have the bond. The kernel then runs over the points of a group with unit-stride loads. Columns ascend by offset, so each point
   meets its bonds in the same order as in the plain list. The list stays: it is the reference, and it decides about breaking.

   Not built (columns NULL) where columns would be mostly empty, where bond vectors are too many to tabulate (clouds), where bonds lead to
   centroids, where materials differ, and for state-based laws with unequal halves or energy criteria. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_VECTOR_LIMIT 1024
#define PERI_VECTOR_SLOTS 4096    /* open addressing                                                                     */
#define PERI_VECTOR_GRAIN 1.5e-11 /* bonds nearer than this, in spacings and largest weights, are one: far above rounding */

typedef struct peri__vector { /* a row of the table, and its key in grains                                                */
    int64_t key[4];
    double  xi[3], bond, weight;
} peri__vector;

typedef struct peri__vectors {
    int32_t      count;
    double       heaviest;                /* largest weight: the unit of its grain                                       */
    int32_t      slot[PERI_VECTOR_SLOTS]; /* row + 1; 0: free                                                            */
    peri__vector row[PERI_VECTOR_LIMIT];
} peri__vectors;

/* The slot of a key: where it is, or where it would be. */
static int32_t *peri__vector_slot(peri__vectors *v, const int64_t *key) {
    uint64_t hash = 0;
    for (int d = 0; d < 4; ++d) hash = (hash ^ (uint64_t)key[d]) * UINT64_C(0x9E3779B97F4A7C15);
    for (size_t slot = (size_t)(hash >> 40) % PERI_VECTOR_SLOTS;; slot = (slot + 1) % PERI_VECTOR_SLOTS)
        if (v->slot[slot] == 0 || memcmp(v->row[v->slot[slot] - 1].key, key, sizeof v->row[0].key) == 0) return &v->slot[slot];
}

/* Table row of bond k of point i, made where it is new; -1 where the table is full, or the bond is no lattice's. */
static int32_t peri__vector_of(peri__vectors *v, const peri_body *b, const double *x, int64_t i, int64_t k) {
    const peri__model *m = b->model;
    int64_t at = i * m->width + k, j = m->ids[at], key[4] = { 0, 0, 0, 0 };
    double xi[3] = { 0.0, 0.0, 0.0 }, weight = peri__get_real(m->weight, b->f32, at);
    for (int32_t d = 0; d < m->dim; ++d) {
        xi[d] = x[j * m->dim + d] - x[i * m->dim + d];
        if (!(fabs(xi[d]) < 1e6)) return -1;
        key[d] = (int64_t)floor(xi[d] / PERI_VECTOR_GRAIN + 0.5);
    }
    key[3] = (int64_t)floor(weight / v->heaviest / PERI_VECTOR_GRAIN + 0.5);
    int32_t *slot = peri__vector_slot(v, key);
    if (*slot == 0) {
        if (v->count == PERI_VECTOR_LIMIT) return -1;
        peri__vector *row = &v->row[v->count];
        memcpy(row->key, key, sizeof key);
        memcpy(row->xi, xi, sizeof xi);
        row->bond = peri__get_real(m->bond, b->f32, at);
        row->weight = weight;
        *slot = ++v->count;
    }
    return *slot - 1;
}

/* Both directions of a bond must have exactly opposite vectors, or momentum drifts by rounding. */
static void peri__oppose_vectors(peri__vectors *v) {
    for (int32_t a = 0; a < v->count; ++a) {
        int64_t key[4];
        for (int d = 0; d < 4; ++d) key[d] = d < 3 ? -v->row[a].key[d] : v->row[a].key[d];
        int32_t other = *peri__vector_slot(v, key) - 1;
        if (other <= a) continue;
        for (int d = 0; d < 3; ++d) v->row[other].xi[d] = -v->row[a].xi[d];
        v->row[other].bond = v->row[a].bond;
        v->row[other].weight = v->row[a].weight;
    }
}

static void peri__sort_entries(int64_t *entry, int64_t count) {
    static const int64_t gaps[] = { 1750, 701, 301, 132, 57, 23, 10, 4, 1 };
    for (int g = 0; g < 9; ++g)
        for (int64_t a = gaps[g]; a < count; ++a) {
            int64_t value = entry[a], at = a;
            for (; at >= gaps[g] && entry[at - gaps[g]] > value; at -= gaps[g]) entry[at] = entry[at - gaps[g]];
            entry[at] = value;
        }
}

/* The bonds of a group as (offset, vector), each once, ascending by offset; their number, or -1 where the table is full. */
static int64_t peri__group_entries(peri__vectors *v, const peri_body *b, const double *x, int64_t group, int64_t *entry) {
    const peri__model *m = b->model;
    int64_t count = 0, kept = 0;
    for (int64_t i = group * PERI_LANES; i < peri__min((group + 1) * PERI_LANES, m->points); ++i)
        for (int64_t k = 0; k < m->count[i]; ++k) {
            int32_t vector = peri__vector_of(v, b, x, i, k);
            if (vector < 0) return -1;
            m->lanes.row[i * m->width + k] = (uint16_t)vector;
            entry[count++] = (m->ids[i * m->width + k] - i) * 65536 + vector;
        }
    peri__sort_entries(entry, count);
    for (int64_t k = 0; k < count; ++k)
        if (k == 0 || entry[k] != entry[k - 1]) entry[kept++] = entry[k];
    return kept;
}

/* Masks of a group from flags[points][words] of the list; all members where flags is NULL. */
static void peri__group_masks(const peri__model *m, int64_t group, const uint32_t *flags, uint16_t *mask) {
    const peri__lanes *lanes = &m->lanes;
    for (int64_t c = lanes->begin[group]; c < lanes->begin[group + 1]; ++c) mask[c] = 0;
    for (int64_t i = group * PERI_LANES; i < peri__min((group + 1) * PERI_LANES, m->points); ++i) {
        int64_t c = lanes->begin[group];
        for (int64_t k = 0; k < m->count[i]; ++k) {
            int64_t offset = m->ids[i * m->width + k] - i, at;
            while (lanes->offset[c] < offset) ++c;
            /* columns of one offset differ by vector where lines of a shape end */
            for (at = c; lanes->vector[at] != lanes->row[i * m->width + k];) ++at;
            if (!flags || (flags[i * m->words + k / 32] >> (k % 32) & 1)) mask[at] = (uint16_t)(mask[at] | 1 << (i % PERI_LANES));
        }
    }
}

static void peri__free_lanes(peri__model *m) {
    peri__lanes *l = &m->lanes;
    peri__delete(&m->memory, l->begin, l->groups + 1, sizeof *l->begin);
    peri__delete(&m->memory, l->offset, l->columns, sizeof *l->offset);
    peri__delete(&m->memory, l->vector, l->columns, sizeof *l->vector);
    peri__delete(&m->memory, l->member, l->columns, sizeof *l->member);
    peri__delete(&m->memory, l->row, m->points * m->width, sizeof *l->row);
    peri__delete(&m->memory, l->table, (int64_t)l->vectors * PERI_TABLE_ROW, sizeof *l->table);
    memset(l, 0, sizeof *l);
}

typedef struct peri__lane_draft { /* what building needs and drops                                                        */
    peri__vectors vectors;
    int64_t      *entry;  /* [width*PERI_LANES] of one group                                                             */
    int64_t      *column; /* (offset, vector) of all columns                                                             */
    int64_t       columns, capacity;
} peri__lane_draft;

/* Collects the columns of all groups: PERI_OK, PERI_ERROR_FAMILY where the points are no lattice, or PERI_ERROR_MEMORY. */
static int32_t peri__draft_lanes(const peri_body *b, peri__lane_draft *draft, const double *x) {
    peri__lanes *l = &b->model->lanes;
    for (int64_t k = 0; k < b->model->points * b->model->width; ++k) {
        double weight = fabs(peri__get_real(b->model->weight, b->f32, k));
        if (weight > draft->vectors.heaviest) draft->vectors.heaviest = weight;
    }
    for (int64_t g = 0; g < l->groups; ++g) {
        int64_t count = peri__group_entries(&draft->vectors, b, x, g, draft->entry);
        if (count < 0) return PERI_ERROR_FAMILY;
        if (!peri__grow(&b->memory, &draft->column, &draft->capacity, draft->columns + count, sizeof *draft->column))
            return PERI_ERROR_MEMORY;
        memcpy(&draft->column[draft->columns], draft->entry, (size_t)count * sizeof *draft->entry);
        l->begin[g] = draft->columns;
        draft->columns += count;
    }
    l->begin[l->groups] = draft->columns;
    /* emptier columns than 2 in 5 are slower than the list */
    return 5 * b->model->bonds >= 2 * PERI_LANES * draft->columns ? PERI_OK : PERI_ERROR_FAMILY;
}

static int32_t peri__keep_lanes(peri_body *b, peri__lane_draft *draft) {
    peri__model *m = b->model;
    peri__lanes *l = &m->lanes;
    int64_t columns = draft->columns;
    peri__oppose_vectors(&draft->vectors);
    l->columns = columns;
    l->vectors = draft->vectors.count;
    l->offset = (int32_t *)peri__new(&m->memory, columns, sizeof *l->offset);
    l->vector = (uint16_t *)peri__new(&m->memory, columns, sizeof *l->vector);
    l->member = (uint16_t *)peri__new(&m->memory, columns, sizeof *l->member);
    l->table = (double *)peri__new(&m->memory, (int64_t)l->vectors * PERI_TABLE_ROW, sizeof *l->table);
    if (!l->offset || !l->vector || !l->member || !l->table) return PERI_ERROR_MEMORY;
    for (int32_t k = 0; k < l->vectors; ++k) {
        const peri__vector *row = &draft->vectors.row[k];
        memcpy(&l->table[k * PERI_TABLE_ROW], row->xi, sizeof row->xi);
        l->table[k * PERI_TABLE_ROW + 3] = row->bond;
        l->table[k * PERI_TABLE_ROW + 4] = row->weight;
    }
    for (int64_t c = 0; c < columns; ++c) {
        int64_t vector = draft->column[c] & 65535;
        l->vector[c] = (uint16_t)vector;
        l->offset[c] = (int32_t)((draft->column[c] - vector) / 65536);
        if (l->offset[c] > l->reach) l->reach = l->offset[c];
    }
    for (int64_t g = 0; g < l->groups; ++g) peri__group_masks(m, g, NULL, l->member);
    return PERI_OK;
}

/* Builds the columns where they pay. x: [points*dim]. Only memory can fail. */
static int32_t peri__build_lanes(peri_body *b, const double *x) {
    peri__model *m = b->model;
    peri__lanes *l = &m->lanes;
    int64_t room = (int64_t)m->width * PERI_LANES;
    int32_t status = PERI_ERROR_MEMORY;
    if (m->centroid || m->materials > 1 || m->back != m->weight || m->works || m->nodes || b->desc.reference) return PERI_OK;
    peri__lane_draft *draft = (peri__lane_draft *)peri__new(&b->memory, 1, sizeof *draft);
    if (draft) draft->entry = (int64_t *)peri__new(&b->memory, room, sizeof *draft->entry);
    l->groups = (m->points + PERI_LANES - 1) / PERI_LANES;
    l->begin = (int64_t *)peri__new(&m->memory, l->groups + 1, sizeof *l->begin);
    l->row = (uint16_t *)peri__new(&m->memory, m->points * m->width, sizeof *l->row);
    if (draft && draft->entry && l->begin && l->row) {
        status = peri__draft_lanes(b, draft, x);
        if (status == PERI_OK) status = peri__keep_lanes(b, draft);
    }
    if (draft) {
        peri__delete(&b->memory, draft->entry, room, sizeof *draft->entry);
        peri__delete(&b->memory, draft->column, draft->capacity, sizeof *draft->column);
    }
    peri__delete(&b->memory, draft, 1, sizeof *draft);
    if (status < 0) peri__free_lanes(m);
    return status == PERI_ERROR_MEMORY ? peri__fail(b, PERI_ERROR_MEMORY, "lanes", -1, 0.0) : PERI_OK;
}

/* Masks of what is alive, brought up to date with the flags of the list. */
static void peri__update_lanes(peri_body *b) {
    if (!b->lanes_stale || !b->lanes_alive) return;
    for (int64_t g = 0; g < b->model->lanes.groups; ++g) peri__group_masks(b->model, g, b->alive, b->lanes_alive);
    b->lanes_stale = 0;
}
