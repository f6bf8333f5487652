/* SPDX-License-Identifier: MIT */
/* stencil.c - families by columns, for points that come from a lattice.

   Rows of Ibond are taken in groups of PERI_GROUP. On a lattice the bonds of a group along one lattice vector lead from each point to
   "own id + offset" with one offset, so a column of them is that offset, one row of a small table of bond vectors, and a mask that says
   which of the points have the bond. The kernel then runs over the points of a group with unit-stride loads. Columns ascend by offset, so
   each point meets its bonds by ascending ids. Groups with the same columns share them: in a box there are few kinds of groups, and most
   of them are recognised by the sizes of their families and the coordinates of their bonds, without looking for neighbours again.

   A body on columns keeps no list: peri__read_row expands a row where one is asked for, and rows decide about breaking. The list is not
   even made on the way, except where the weights of bonds are corrected, or families are the caller's.

   Not built (no columns) where columns would be mostly empty, where bond vectors are too many to tabulate (clouds), where bonds lead to
   centroids, and for halves that weigh differently. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_VECTOR_SLOTS 4096    /* open addressing                                                                     */
#define PERI_VECTOR_GRAIN 1.5e-11 /* bonds nearer than this, in spacings and weights, are one: far above rounding        */
#define PERI_VECTOR_KEY 6
#define PERI_KINDS 1024           /* a power of 2                                                                        */
#define PERI_KIND_ROOM 8

typedef struct peri__vector { /* a row of the table, its key in quanta, and the first bond that made it                   */
    int64_t   key[PERI_VECTOR_KEY]; /* xi, weight, beta V_j; the pair of materials                                       */
    peri__bond bond;
    double    length, weight; /* rounded as bond                                                                         */
    double    own, other;     /* V_i, V_j                                                                                */
} peri__vector;

typedef struct peri__builder { /* what building needs and drops                                                          */
    peri__cloud  *cloud;
    int64_t       bonds, width;
    double        row_sum;           /* see peri__row_sum_block                                                          */
    double        weight, partial_volume;  /* units of the quanta of weights: of the order of the largest weight and volume */
    int32_t       count;          /* of vectors                                                                          */
    int32_t       slot[PERI_VECTOR_SLOTS]; /* row + 1; 0: free                                                           */
    peri__vector  row[PERI_VECTOR_LIMIT];
    peri__column  group[2][PERI_GROUP * PERI_VECTOR_LIMIT]; /* columns of the group at hand, and room for the next state */
    int64_t       group_count;
    int           now;            /* which of the two                                                                    */
    peri__column *column;         /* of all groups that differ                                                           */
    int64_t       columns, capacity;
    int32_t      *seen;           /* [seen_slots] open addressing: a group with such columns + 1; 0: free                */
    int64_t       seen_slots;     /* a power of 2                                                                        */
    int           alike;          /* bonds with the same vector have the same weight                                     */
    int32_t       kind[PERI_KINDS][PERI_KIND_ROOM]; /* group + 1 by the sizes of its families, the last first; 0: free    */
    int32_t      *like;           /* those of the group at hand; NULL where they serve nothing                           */
    int32_t       ids[PERI_VECTOR_LIMIT]; /* the family of point ids_of, ascending                                       */
    int64_t       ids_of;
    peri__near    around;
    peri__partial_volumes   parts;
} peri__builder;

/* Both directions of a bond have opposite grains. */
static int64_t peri__quanta(double value, double unit) {
    double grains = floor(fabs(value) / (unit * PERI_VECTOR_GRAIN) + 0.5);
    return value < 0.0 ? -(int64_t)grains : (int64_t)grains;
}

/* The slot of a key: where it is, or where it would be. */
static int32_t *peri__vector_slot(peri__builder *d, const int64_t *key) {
    uint64_t hash = 0;
    for (int k = 0; k < PERI_VECTOR_KEY; ++k) hash = (hash ^ (uint64_t)key[k]) * UINT64_C(0x9E3779B97F4A7C15);
    for (size_t slot = (size_t)(hash >> 40) % PERI_VECTOR_SLOTS;; slot = (slot + 1) % PERI_VECTOR_SLOTS)
        if (d->slot[slot] == 0 || memcmp(d->row[d->slot[slot] - 1].key, key, sizeof d->row[0].key) == 0) return &d->slot[slot];
}

static int32_t peri__pair_of(const peri__model *m, int64_t i, int64_t j) { return m->material[i] * m->materials + m->material[j]; }

static double peri__rounded(int b32, double value) { return b32 ? (double)(float)value : value; }

static double peri__quotient(int b32, double a, double b) { return b32 ? (double)((float)a / (float)b) : a / b; }

/* Table row of bond (i, j), made where it is new; -1 where the table is full, or the bond is no lattice's. */
static int32_t peri__vector_of(peri__builder *d, int64_t i, int64_t j, const peri__bond *bond) {
    const peri__model *m = d->cloud->model;
    const int b32 = d->cloud->body->b32;
    int64_t key[PERI_VECTOR_KEY] = { 0 };
    double weight = peri__rounded(b32, bond->weight);
    for (int32_t k = 0; k < m->dim; ++k) {
        if (!(fabs(bond->xi[k]) < 1e6)) return -1;
        key[k] = peri__quanta(bond->xi[k], 1.0);
    }
    if (!(fabs(weight) < 1e6 * d->weight)) return -1;
    key[3] = peri__quanta(bond->weight, d->weight); /* rounded to float it could be of two grains */
    key[4] = peri__quanta(bond->partial_volume, d->partial_volume);
    key[5] = peri__pair_of(m, i, j);
    int32_t *slot = peri__vector_slot(d, key);
    if (*slot == 0) {
        if (d->count == PERI_VECTOR_LIMIT) return -1;
        peri__vector *row = &d->row[d->count];
        memcpy(row->key, key, sizeof key);
        row->bond = *bond;
        row->length = peri__rounded(b32, bond->length);
        row->weight = weight;
        row->own = m->volume[i];
        row->other = m->volume[j];
        *slot = ++d->count;
    }
    return *slot - 1;
}

/* Have two rows the same vector or opposite ones, and the same of what else is in the first `keys` of their keys? */
static int peri__is_along(const peri__vector *a, const peri__vector *other, int keys) {
    int same = 1, opposite = 1;
    for (int k = 0; k < keys; ++k) {
        same &= a->key[k] == other->key[k];
        opposite &= a->key[k] == (k < 3 ? -other->key[k] : other->key[k]);
    }
    return same || opposite;
}

/* Both directions of a bond must have exactly opposite vectors and the same length, whatever they weigh, or momentum drifts by rounding,
   and only one of them breaks: they get those of the first row that is alike. What weighs the same must to the last bit. */
static void peri__oppose_vectors(peri__builder *d) {
    const int32_t materials = d->cloud->model->materials, mutual = d->cloud->model->mutual;
    for (int32_t a = 0; a < d->count; ++a) {
        peri__vector *row = &d->row[a];
        int64_t key[PERI_VECTOR_KEY];
        int32_t first = 0;
        for (int k = 0; k < 5; ++k) key[k] = k < 3 ? -row->key[k] : row->key[k];
        key[5] = row->key[5] % materials * materials + row->key[5] / materials;
        const int32_t other = *peri__vector_slot(d, key) - 1;
        if (other > a) {
            d->row[other].weight = row->weight;
            d->row[other].bond.partial_volume = row->bond.partial_volume;
        }
        for (int32_t like = 0; mutual && like < a; ++like) /* beta V_j of the two ends differs, what they weigh does not */
            if (peri__is_along(&d->row[like], row, 4)) {
                row->weight = d->row[like].weight;
                break;
            }
        while (!peri__is_along(&d->row[first], row, 3)) ++first;
        const int same = memcmp(d->row[first].key, row->key, 3 * sizeof *key) == 0;
        for (int k = 0; k < 3; ++k) row->bond.xi[k] = same ? d->row[first].bond.xi[k] : -d->row[first].bond.xi[k];
        row->length = d->row[first].length;
    }
}

/* Bond k of the list. */
static void peri__listed_bond(const peri__cloud *c, int64_t i, int64_t k, peri__bond *bond) {
    const peri__model *m = c->model;
    const int64_t at = m->start[i] + k, j = m->ids[at];
    peri__bond_vector(c, i, j, bond->xi);
    bond->length = peri__listed_length(c, i, at);
    bond->weight = peri__get_real(m->weight, c->body->b32, at);
    bond->partial_volume = m->partial_volume ? (double)m->partial_volume[at] : m->volume[j];
}

/* Is bond (i, j) bit by bit that which made the row? Where its weight is not known yet (whole cells and the ramp) that of the row then
   is its own. */
static int peri__is_vector(const peri__builder *d, const peri__vector *row, int64_t i, int64_t j, const peri__bond *bond, int weighed) {
    const peri__model *m = d->cloud->model;
    if (row->key[5] != peri__pair_of(m, i, j)) return 0;
    for (int32_t k = 0; k < m->dim; ++k)
        if (bond->xi[k] != row->bond.xi[k]) return 0;
    if (!weighed) return m->volume[i] == row->own && m->volume[j] == row->other;
    return bond->weight == row->bond.weight && bond->partial_volume == row->bond.partial_volume && bond->length == row->bond.length;
}

/* Adds the family of i to the columns of its group. 0 where this is no lattice, or no family. */
static int peri__build_row(peri__builder *d, int64_t i, const int32_t *ids, int64_t count) {
    const peri__cloud *c = d->cloud;
    const peri__model *m = c->model;
    const int listed = m->ids != NULL, weighed = listed || peri__is_exact(c->body->desc.quadrature), b32 = c->body->b32;
    const uint16_t bit = (uint16_t)(1 << (i % PERI_GROUP));
    const peri__column *old = d->group[d->now], *old_end = old + d->group_count;
    peri__column *made = d->group[!d->now], *next = made;
    double total = 0.0, stiff = 0.0, row_sum = 0.0;
    const double share = peri__share(m, i);
    peri__bond own;
    memset(&own, 0, sizeof own);
    for (int64_t k = 0; k < count; ++k) {
        const int64_t j = ids[k];
        const int32_t offset = (int32_t)(j - i);
        const peri__bond *bond = &own;
        int32_t vector = -1;
        if (listed) peri__listed_bond(c, i, k, &own);
        else if (!weighed) peri__bond_vector(c, i, j, own.xi);
        else if (!peri__weigh_bond(c, &d->parts, i, j, &own)) return 0;
        while (old < old_end && old->offset < offset) *next++ = *old++;
        for (const peri__column *same = old; same < old_end && same->offset == offset && vector < 0; ++same)
            if (peri__is_vector(d, &d->row[same->vector], i, j, &own, weighed)) vector = same->vector;
        if (vector >= 0) {
            bond = &d->row[vector].bond;
        } else {
            if (!weighed && !peri__weigh_bond(c, &d->parts, i, j, &own)) return 0;
            if (!peri__finite(peri__rounded(b32, own.weight))) return 0;
            vector = peri__vector_of(d, i, j, &own);
            if (vector < 0) return 0;
        }
        total += fabs(bond->weight) / share;
        stiff += bond->weight * bond->length * bond->length / share;
        row_sum += m->pairs[d->row[vector].key[5]].c * fabs(peri__rounded(b32, bond->weight)) / peri__rounded(b32, bond->length) / share;
        while (old < old_end && old->offset == offset && old->vector < vector) *next++ = *old++;
        if (old < old_end && old->offset == offset && old->vector == vector) {
            *next = *old++;
        } else {
            next->offset = offset;
            next->vector = (uint16_t)vector;
            next->member = 0;
        }
        next->member = (uint16_t)(next->member | bit);
        ++next;
    }
    while (old < old_end) *next++ = *old++;
    d->now = !d->now;
    d->group_count = next - made;
    d->bonds += count;
    if (count > d->width) d->width = count;
    row_sum *= 2.0 / m->rho[m->material[i]];
    if (row_sum > d->row_sum) d->row_sum = row_sum; /* of ghosts, too: they have less than where they are owned */
    return peri__check_weight(c->body, total, stiff, m->pairwise) == PERI_OK;
}

/* Keeps the columns of the group at hand, or finds an earlier group with the same. */
static int32_t peri__build_group(peri__builder *d, int64_t g) {
    const peri__memory *memory = &d->cloud->body->scratch;
    peri__stencil *l = &d->cloud->model->stencil;
    const peri__column *group = d->group[d->now];
    const size_t bytes = (size_t)d->group_count * sizeof *group;
    uint64_t hash = 0;
    for (int64_t c = 0; c < d->group_count; ++c) {
        hash = (hash ^ (uint32_t)group[c].offset) * UINT64_C(0x9E3779B97F4A7C15);
        hash = (hash ^ (hash >> 32) ^ ((uint32_t)group[c].vector << 16 | group[c].member)) * UINT64_C(0x9E3779B97F4A7C15);
    }
    l->begin[g + 1] = l->begin[g] + d->group_count;
    int64_t slot = (int64_t)(hash >> 20) & (d->seen_slots - 1);
    for (; d->seen[slot] != 0; slot = (slot + 1) & (d->seen_slots - 1)) {
        const int64_t other = d->seen[slot] - 1;
        if (l->begin[other + 1] - l->begin[other] != d->group_count) continue;
        if (memcmp(&d->column[l->first[other]], group, bytes) != 0) continue;
        l->first[g] = l->first[other];
        return PERI_OK;
    }
    if (!peri__grow(memory, &d->column, &d->capacity, d->columns + d->group_count, sizeof *d->column)) return PERI_ERROR_MEMORY;
    memcpy(&d->column[d->columns], group, bytes);
    l->first[g] = d->columns;
    d->columns += d->group_count;
    d->seen[slot] = (int32_t)(g + 1);
    return PERI_OK;
}

/* Units of the grains of weights, by the first family. */
static void peri__choose_units(peri__builder *d, const int32_t *ids, int64_t count) {
    const peri__model *m = d->cloud->model;
    peri__bond bond;
    for (int64_t i = 0; i < m->points; ++i)
        if (m->volume[i] > d->partial_volume) d->partial_volume = m->volume[i];
    for (int64_t k = 0; k < count; ++k) {
        if (m->ids) peri__listed_bond(d->cloud, 0, k, &bond);
        else if (!peri__weigh_bond(d->cloud, &d->parts, 0, ids[k], &bond)) continue;
        double weight = fabs(bond.weight) / m->volume[ids[k]] * d->partial_volume;
        if (m->mutual) weight *= d->partial_volume / m->volume[0];
        if (weight > d->weight) d->weight = weight;
    }
}

/* How many of the differences there - here are not bit by bit as wanted. */
#define PERI_UNLIKE(isa, target)                                                                                       \
    target static int64_t peri__unlike_##isa(const double *there, const double *here, const double *want, int count) { \
        int64_t unlike = 0;                                                                                            \
        for (int n = 0; n < count; ++n) unlike += there[n] - here[n] != want[n];                                       \
        return unlike;                                                                                                 \
    }
PERI_UNLIKE(plain, PERI_VECTOR_CODE)
#ifdef PERI_ISA
PERI_UNLIKE(avx2, PERI_VECTOR_CODE PERI_TARGET_AVX2)
PERI_UNLIKE(avx512, PERI_VECTOR_CODE PERI_TARGET_AVX512)
#endif
#undef PERI_UNLIKE

/* Do the columns of group `other`, moved, hold the families of group g? They do where every bond of theirs is bit by bit that of its table
   row, and every point has as many as were counted. The same columns would then be drafted. */
static int peri__fits_group(const peri__builder *d, int64_t g, int64_t other) {
    const peri__model *m = d->cloud->model;
    const peri__stencil *l = &m->stencil;
    const int32_t dim = m->dim;
    const int64_t columns = l->begin[other + 1] - l->begin[other];
    const double *here = &d->cloud->x[g * PERI_GROUP * dim];
    double want[PERI_GROUP / 2 * 3]; /* xi of half a group */
    for (int64_t k = 0; k < columns; ++k) {
        const peri__column *column = &d->column[l->first[other] + k];
        const double *xi = d->row[column->vector].bond.xi;
        const int64_t first = g * PERI_GROUP + column->offset;
        int64_t apart = 0;
        if (column->member == 0xffff) {
            if (first < 0 || first + PERI_GROUP > m->points) return 0;
            const double *there = &d->cloud->x[first * dim];
            for (int n = 0; n < PERI_GROUP / 2; ++n)
                for (int32_t a = 0; a < dim; ++a) want[n * dim + a] = xi[a];
            for (int half = 0; half < 2; ++half)
                apart += PERI_BY_ISA(d->cloud->isa, peri__unlike,
                                     (there + half * PERI_GROUP / 2 * dim, here + half * PERI_GROUP / 2 * dim, want, PERI_GROUP / 2 * dim));
        } else {
            for (int n = 0; n < PERI_GROUP; ++n) {
                if (!(column->member >> n & 1)) continue;
                if (first + n < 0 || first + n >= m->points) return 0;
                for (int32_t a = 0; a < dim; ++a) apart += d->cloud->x[(first + n) * dim + a] - here[n * dim + a] != xi[a];
            }
        }
        if (apart) return 0;
    }
    return 1;
}

/* An earlier group with the columns of group g, or -1. Tried are the last groups whose families were as large, point by point. */
static int64_t peri__like_group(peri__builder *d, int64_t g) {
    const peri__model *m = d->cloud->model;
    const int32_t *count = &m->count[g * PERI_GROUP];
    uint64_t hash = 0;
    d->like = NULL;
    if (!d->alike || (g + 1) * PERI_GROUP > m->points) return -1;
    for (int n = 0; n < PERI_GROUP; ++n) hash = (hash ^ (uint32_t)count[n]) * UINT64_C(0x9E3779B97F4A7C15);
    d->like = d->kind[hash >> 32 & (PERI_KINDS - 1)];
    for (int n = 0; n < PERI_KIND_ROOM && d->like[n] != 0; ++n) {
        const int64_t other = d->like[n] - 1;
        if (memcmp(count, &m->count[other * PERI_GROUP], PERI_GROUP * sizeof *count) == 0 && peri__fits_group(d, g, other)) return other;
    }
    return -1;
}

/* Group g has the columns of an earlier one. */
static void peri__repeat_group(peri__builder *d, int64_t g, int64_t other) {
    peri__stencil *l = &d->cloud->model->stencil;
    const int64_t columns = l->begin[other + 1] - l->begin[other];
    l->first[g] = l->first[other];
    l->begin[g + 1] = l->begin[g] + columns;
    for (int n = 0; n < PERI_GROUP; ++n) d->bonds += d->cloud->model->count[g * PERI_GROUP + n];
}

/* Turns the family at hand, of point i - 1, into that of i, which on a lattice often is the same, moved: where it is as large, and its
   bonds are bit by bit those of the other. 0 where it is not. */
static int peri__shift_row(peri__builder *d, int64_t i) {
    const peri__model *m = d->cloud->model;
    const int32_t dim = m->dim;
    const double *x = &d->cloud->x[i * dim];
    if (!d->alike || i == 0 || d->ids_of != i - 1 || m->count[i] != m->count[i - 1]) return 0;
    if (d->ids[m->count[i] - 1] + 1 >= m->points) return 0;
    for (int32_t k = 0; k < m->count[i]; ++k) {
        const double *there = &d->cloud->x[((int64_t)d->ids[k] + 1) * dim];
        int apart = 0;
        for (int32_t a = 0; a < dim; ++a) apart |= there[a] - x[a] != there[a - dim] - x[a - dim];
        if (apart) return 0;
    }
    for (int32_t k = 0; k < m->count[i]; ++k) ++d->ids[k];
    d->ids_of = i;
    return 1;
}

/* Point i has the bonds of point i - 1, moved, and so is in the same columns. */
static void peri__widen_columns(peri__builder *d, int64_t i) {
    peri__column *group = d->group[d->now];
    const int lane = (int)(i % PERI_GROUP);
    for (int64_t k = 0; k < d->group_count; ++k) group[k].member |= (uint16_t)((group[k].member >> (lane - 1) & 1) << lane);
    d->bonds += d->cloud->model->count[i];
}

/* Collects the columns of all groups: PERI_OK, PERI_ERROR_FAMILY where they serve nothing, or PERI_ERROR_MEMORY. */
static int32_t peri__build_groups(peri__builder *d) {
    const peri__model *m = d->cloud->model;
    for (int64_t i = 0; i < m->points; ++i) {
        if (m->count[i] > PERI_VECTOR_LIMIT) return PERI_ERROR_FAMILY;
        if (i % PERI_GROUP == 0) {
            const int64_t other = peri__like_group(d, i / PERI_GROUP);
            if (other >= 0) {
                peri__repeat_group(d, i / PERI_GROUP, other);
                i += PERI_GROUP - 1;
                continue;
            }
        }
        const int32_t *ids = m->ids ? &m->ids[m->start[i]] : d->ids;
        const int shifted = !m->ids && peri__shift_row(d, i);
        if (!m->ids && !shifted) {
            (void)peri__visit_family(d->cloud, i, &d->around, d->ids, PERI_VECTOR_LIMIT);
            peri__sort_row(d->ids, m->count[i]);
            d->ids_of = i;
        }
        if (i == 0) peri__choose_units(d, ids, m->count[0]);
        if (i % PERI_BLOCK == 0 && !d->alike) peri__clear_partial_volumes(&d->parts);
        if (i % PERI_GROUP == 0) d->group_count = 0;
        if (shifted && i % PERI_GROUP != 0) peri__widen_columns(d, i);
        else if (!peri__build_row(d, i, ids, m->count[i])) return PERI_ERROR_FAMILY;
        if ((i + 1) % PERI_GROUP != 0 && i + 1 < m->points) continue;
        if (peri__build_group(d, i / PERI_GROUP) < 0) return PERI_ERROR_MEMORY;
        if (d->like) { /* first of its kind from now on */
            memmove(d->like + 1, d->like, (PERI_KIND_ROOM - 1) * sizeof *d->like);
            d->like[0] = (int32_t)(i / PERI_GROUP + 1);
        }
    }
    /* emptier columns than 2 in 5 take more than twice the time of the list: too much for the memory that they save */
    return m->part || 5 * d->bonds >= 2 * PERI_GROUP * m->stencil.begin[m->stencil.groups] ? PERI_OK : PERI_ERROR_FAMILY;
}

static void peri__free_stencil(peri__model *m) {
    peri__stencil *l = &m->stencil;
    peri__delete(&m->memory, l->begin, l->groups + 1, sizeof *l->begin);
    peri__delete(&m->memory, l->first, l->groups, sizeof *l->first);
    peri__delete(&m->memory, l->column, l->kept, sizeof *l->column);
    peri__delete(&m->memory, l->table, l->vectors, sizeof *l->table);
    peri__delete(&m->memory, l->ends, l->vectors, sizeof *l->ends);
    memset(l, 0, sizeof *l);
}

/* g of an end of a bond, 0 of pairwise laws. */
static double peri__end_gauge(const peri__law *law, double length) { return law->pairwise ? 0.0 : law->gauge ? length : 1.0; }

static void peri__fill_ends(const peri__model *m, const peri__vector *row, peri__stencil_ends *ends) {
    const int32_t own = (int32_t)row->key[5] / m->materials, other = (int32_t)row->key[5] % m->materials;
    double spring[2] = { 0.0, 0.0 };
    ends->gauge = peri__end_gauge(&m->laws[own], row->length);
    ends->other_gauge = peri__end_gauge(&m->laws[other], row->length);
    if (m->laws[own].pairwise) spring[0] = peri__quotient(m->b32, 0.5 * m->pairs[row->key[5]].c, row->length);
    if (m->laws[other].pairwise) spring[1] = peri__quotient(m->b32, 0.5 * m->pairs[other * m->materials + own].c, row->length);
    ends->spring = m->b32 ? (double)((float)spring[0] + (float)spring[1]) : spring[0] + spring[1]; /* as the rows add them */
    ends->energy = m->pairs[row->key[5]].limit[PERI_CRITERION_BOND_ENERGY - peri__first_criterion] * row->bond.partial_volume;
}

static int32_t peri__keep_stencil(peri__builder *d) {
    peri__model *m = d->cloud->model;
    peri__stencil *l = &m->stencil;
    peri__oppose_vectors(d);
    l->kept = d->columns;
    l->vectors = d->count;
    l->column = (peri__column *)peri__copy(&m->memory, d->column, l->kept, sizeof *l->column);
    l->table = (peri__stencil_bond *)peri__new(&m->memory, l->vectors, sizeof *l->table);
    const int ends = m->mixed || m->seen_by & PERI__BY_WORK;
    if (ends) l->ends = (peri__stencil_ends *)peri__new(&m->memory, l->vectors, sizeof *l->ends);
    if (!l->column || !l->table || (!l->ends && ends)) return PERI_ERROR_MEMORY;
    for (int32_t k = 0; k < l->vectors; ++k) {
        const peri__vector *row = &d->row[k];
        peri__stencil_bond *entry = &l->table[k];
        memcpy(entry->xi, row->bond.xi, sizeof row->bond.xi);
        entry->length = row->length;
        entry->weight = row->weight;
        entry->partial_volume = row->bond.partial_volume;
        entry->inverse = m->b32 ? (double)(1 / (float)row->length) : 1 / row->length; /* as the rows take it */
        entry->c = m->pairs[row->key[5]].c;
        entry->s0 = m->pairs[row->key[5]].s0;
        if (l->ends) peri__fill_ends(m, row, &l->ends[k]);
    }
    for (int64_t c = 0; c < l->kept; ++c)
        if (l->column[c].offset > l->reach) l->reach = l->column[c].offset;
    l->columns = l->begin[l->groups];
    l->partial = d->cloud->body->desc.quadrature != PERI_QUADRATURE_FULL;
    m->width = (int32_t)d->width;
    m->bonds = d->bonds;
    if (m->pairwise) m->row_sum = d->row_sum;
    return PERI_OK;
}

/* Have bonds with the same vector the same weight? Where there is one material, all points have one volume, and parts of cells, too, depend
   on the vector alone. */
static int peri__is_alike(const peri__cloud *c) {
    const peri__setup *s = &c->body->setup;
    const int box = s->piece_count == 1 && s->pieces[0].lattice && !s->pieces[0].vertices;
    return !c->model->ids && c->model->materials == 1 && c->even > 0.0 && (!peri__is_exact(c->body->desc.quadrature) || box);
}

/* The first point with a bond that is lost in the rounding of single precision, or -1. Forces by columns would not notice: what else asks
   for the places of points would. */
static int64_t peri__find_lost(const peri__cloud *c) {
    const peri__model *m = c->model;
    const peri__stencil *l = &m->stencil;
    double shortest = HUGE_VAL;
    for (int32_t k = 0; k < l->vectors; ++k) shortest = l->table[k].length < shortest ? l->table[k].length : shortest;
    for (int64_t i = 0; c->body->f32 && shortest < PERI_LOSABLE * m->extent && i < m->points; ++i) {
        const int64_t g = i / PERI_GROUP;
        for (int64_t k = 0; k < l->begin[g + 1] - l->begin[g]; ++k) {
            const peri__column *column = &l->column[l->first[g] + k];
            if (column->member >> (i % PERI_GROUP) & 1 && peri__is_lost(c, i, i + column->offset)) return i;
        }
    }
    return -1;
}

/* Makes the columns where they pay, from the list where there is one and else from the points. 1: made; 0: not; else an error. */
static int32_t peri__build_stencil(peri_body *b, peri__cloud *c) {
    peri__model *m = c->model;
    peri__stencil *l = &m->stencil;
    int32_t status = PERI_ERROR_MEMORY;
    if (b->desc.quadrature == PERI_QUADRATURE_PARTIAL_CENTROID) return 0;
    if (b->desc.kernel != PERI_KERNEL_BEST || b->bond_law_count > 0) return 0; /* laws of bonds go by rows               */
    if (b->desc.correction == PERI_CORRECTION_EQUILIBRIUM) return 0; /* no two families are alike                         */
    if (m->ids ? m->back != m->weight : b->setup.ibond || peri__corrects(b, m)) return 0;
    peri__builder *d = (peri__builder *)peri__new(&b->scratch, 1, sizeof *d);
    l->groups = (m->points + PERI_GROUP - 1) / PERI_GROUP;
    l->begin = (int64_t *)peri__new(&m->memory, l->groups + 1, sizeof *l->begin);
    l->first = (int64_t *)peri__new(&m->memory, l->groups, sizeof *l->first);
    if (d) {
        d->cloud = c;
        d->alike = peri__is_alike(c);
        d->ids_of = -1;
        d->seen_slots = 16;
        while (d->seen_slots < 2 * l->groups) d->seen_slots *= 2;
        d->seen = (int32_t *)peri__new(&b->scratch, d->seen_slots, sizeof *d->seen);
        if (d->seen && l->begin && l->first) status = peri__build_groups(d);
        if (status == PERI_OK) status = peri__keep_stencil(d);
        peri__delete(&b->scratch, d->seen, d->seen_slots, sizeof *d->seen);
        peri__delete(&b->scratch, d->column, d->capacity, sizeof *d->column);
        peri__delete(&b->scratch, d, 1, sizeof *d);
    }
    const int64_t lost = status == PERI_OK ? peri__find_lost(c) : -1;
    if (status < 0) peri__free_stencil(m);
    if (lost >= 0) return peri__fail(b, PERI_ERROR_COINCIDENT, "precision", lost, 0.0);
    return status == PERI_OK ? 1 : status == PERI_ERROR_MEMORY ? peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0) : 0;
}

/* Brings the masks of the columns of a group up to date with flags[points][words], bit k of a row for its k-th bond, in some lanes. */
PERI_SHARED void peri__group_masks(const peri__model *m, int64_t g, uint32_t lanes, const uint32_t *flags, uint16_t *masks) {
    const peri__stencil *l = &m->stencil;
    const peri__column *column = &l->column[l->first[g]];
    const int64_t count = l->begin[g + 1] - l->begin[g];
    uint16_t *mask = &masks[l->begin[g]];
    for (int lane = 0; lane < PERI_GROUP; ++lane) {
        const int64_t row = (g * PERI_GROUP + lane) * m->words;
        int64_t k = 0; /* the bond that comes next */
        if (!(lanes >> lane & 1)) continue;
        for (int64_t c = 0; c < count; ++c) {
            if (!(column[c].member >> lane & 1)) continue;
            mask[c] = (uint16_t)((mask[c] & ~(1u << lane)) | (flags[row + k / 32] >> (k % 32) & 1) << lane);
            ++k;
        }
    }
}

/* Masks where all bonds are alive. */
static void peri__whole_masks(const peri__model *m, uint16_t *masks) {
    const peri__stencil *l = &m->stencil;
    for (int64_t g = 0; g < l->groups; ++g) {
        const peri__column *column = &l->column[l->first[g]];
        for (int64_t c = l->begin[g]; c < l->begin[g + 1]; ++c) masks[c] = (column++)->member;
    }
}

/* Masks of what is alive, brought up to date with the flags. */
static void peri__update_masks(peri_body *b) {
    if (!(b->now.stale & PERI__STALE_MASKS)) return;
    for (int64_t g = 0; b->masks && g < b->model->stencil.groups; ++g)
        peri__group_masks(b->model, g, ~(uint32_t)0, b->alive, b->masks);
    b->now.stale &= ~(uint32_t)PERI__STALE_MASKS;
}
