/* SPDX-License-Identifier: MIT */
/* neighbors.c - points to families: the array Ibond of [T] 3.11, its rows without padding. Searched by search.c, or checked where the
   caller gave them.

   Rows that were searched lie in the order of places (search.c), and hold the places of neighbours, ascending: passes over the list then
   meet points whose neighbours, and the records of these, are near in memory, however the points are numbered. They hold ids, ascending,
   as rows of the caller do, where columns may be made of them, and where families are larger than the room of peri__row. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_NEAR_AHEAD 8 /* points whose entries, anywhere in memory, are asked for before their turn                   */

static void peri__sort_row(int32_t *row, int64_t count) {
    /* shell sort: rows are short, and runs of neighbouring cells are ascending already */
    static const int64_t gaps[] = { 132, 57, 23, 10, 4, 1 };
    for (int g = 0; g < 6; ++g)
        for (int64_t a = gaps[g]; a < count; ++a) {
            int32_t id = row[a];
            int64_t at = a;
            for (; at >= gaps[g] && row[at - gaps[g]] > id; at -= gaps[g]) row[at] = row[at - gaps[g]];
            row[at] = id;
        }
}

/* ---- families that are searched ----------------------------------------------------------------------------------- */

/* Sizes of the families of the points in a block of cells. sums->n: how many points are where one of them is, itself included. */
static void peri__count_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cloud *c = (const peri__cloud *)context;
    const int whole = c->body->desc.quadrature == PERI_QUADRATURE_FULL;
    peri__near s;
    for (int64_t cell = begin; cell < end; ++cell) {
        if (c->start[cell] == c->start[cell + 1]) continue;
        peri__look_around(c, cell, &s);
        for (int first = 1; peri__next_near(&s) > 0; first = 0)
            for (int32_t p = c->start[cell]; p < c->start[cell + 1]; ++p) {
                int32_t *count = &c->model->count[c->order[p]];
                double x[3];
                PERI_PREFETCH(&c->model->count[c->order[peri__min(p + PERI_NEAR_AHEAD, c->model->points - 1)]]);
                peri__place_of(c, p, x);
                int64_t within = peri__count_near(c, &s, x, &sums->n);
                if (whole) within -= first; /* the point itself */
                else within = peri__keep_family(c, &s, peri__take_near(c, &s, x, p), p);
                *count = (int32_t)(within + (first ? 0 : *count));
            }
    }
}

/* Of the points at the same place as another the first, and the first of those with it. */
static int32_t peri__refuse_twins(peri_body *b, const peri__cloud *c) {
    peri__near s;
    for (int64_t i = 0;; ++i) {
        const int64_t twin = peri__twin_of(c, i, &s);
        if (twin >= 0) return peri__fail(b, PERI_ERROR_COINCIDENT, "positions", twin, (double)i);
    }
}

/* Sorts the points and counts their families. */
static int32_t peri__count_families(peri_body *b, peri__cloud *c) {
    peri__model *m = c->model;
    int64_t same = 0;
    peri__set_reach(c);
    int32_t status = peri__sort_cells(c);
    peri__sums *sums = (peri__sums *)peri__new(&m->memory, c->cell_count / PERI_BLOCK + 1, sizeof *sums);
    if (status == PERI_OK && sums) {
        peri__for_points(b, c->cell_count, 256, peri__count_block, c, sums);
        same = peri__total(sums, c->cell_count).n;
    }
    peri__delete(&m->memory, sums, c->cell_count / PERI_BLOCK + 1, sizeof *sums);
    if (status < 0 || !sums) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    return same > m->points ? peri__refuse_twins(b, c) : PERI_OK;
}

/* Room for the rows, by m->count. 0 where memory is short. */
static int peri__make_rows(peri__model *m) {
    m->start = (int64_t *)peri__new(&m->memory, m->points, sizeof *m->start);
    if (!m->start) return 0;
    m->width = 1;
    m->bonds = 0;
    for (int64_t k = 0; k < m->points; ++k) {
        const int64_t i = peri__nth(m, k);
        m->start[i] = m->bonds;
        m->bonds += m->count[i];
        if (m->count[i] > m->width) m->width = m->count[i];
    }
    m->entries = m->bonds + PERI_GROUP;
    m->ids = (int32_t *)peri__new_tail(&m->memory, m->entries, sizeof *m->ids, PERI_GROUP);
    return m->ids != NULL;
}

/* Which bond of row i of the list leads to j, or -1. Rows lie in the order of places, so these ascend with `start`. */
static int64_t peri__find_listed(const peri__model *m, int64_t i, int64_t j) {
    const int32_t *row = &m->ids[m->start[i]];
    int64_t lo = 0, hi = m->count[i];
    while (lo < hi) {
        int64_t mid = (lo + hi) / 2;
        if (m->order ? m->start[m->order[row[mid]]] < m->start[j] : row[mid] < j) lo = mid + 1;
        else hi = mid;
    }
    return lo < m->count[i] && (m->order ? m->order[row[lo]] : row[lo]) == j ? lo : -1;
}

/* Place of the last entry j in the caller's row i. */
static int64_t peri__given_entry(const peri__setup *s, int64_t i, int64_t j) {
    int64_t k = (i + 1) * s->ibond_width - 1;
    while (k > i * s->ibond_width && s->ibond[k] != j) --k;
    return k;
}

/* The caller's rows: ids checked, padding out, ascending, each in the row of its partner too. */
static int32_t peri__take_families(peri_body *b, peri__cloud *c) {
    const peri__setup *s = &b->setup;
    peri__model *m = c->model;
    if (s->ibond_entries != s->point_count * s->ibond_width)
        return peri__fail(b, PERI_ERROR_IBOND, "ibond", -1, (double)s->ibond_entries);
    for (int64_t k = 0; k < s->ibond_entries; ++k) {
        int64_t i = k / s->ibond_width, j = s->ibond[k];
        if (j < 0 || j >= m->points) return peri__fail(b, PERI_ERROR_IBOND, "ibond", k, (double)j);
        m->count[i] += j != i;
    }
    if (!peri__make_rows(m)) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    for (int64_t i = 0; i < m->points; ++i) {
        int32_t *row = &m->ids[m->start[i]];
        int64_t count = 0;
        for (int64_t k = i * s->ibond_width; k < (i + 1) * s->ibond_width; ++k)
            if (s->ibond[k] != i) row[count++] = s->ibond[k];
        peri__sort_row(row, count);
        for (int64_t k = 1; k < count; ++k)
            if (row[k] == row[k - 1])
                return peri__fail(b, PERI_ERROR_IBOND, "ibond", peri__given_entry(s, i, row[k]), (double)row[k]);
    }
    for (int64_t i = 0; i < m->points; ++i)
        for (int64_t k = 0; k < m->count[i]; ++k) {
            int64_t j = m->ids[m->start[i] + k];
            double square = 0.0;
            if (peri__find_listed(m, j, i) < 0)
                return peri__fail(b, PERI_ERROR_IBOND, "ibond", peri__given_entry(s, i, j), (double)j);
            for (int32_t d = 0; d < m->dim; ++d) square += peri__square(c->x[j * m->dim + d] - c->x[i * m->dim + d]);
            if (square < PERI_COINCIDENT) return peri__fail(b, PERI_ERROR_COINCIDENT, "positions", i > j ? i : j, (double)(i > j ? j : i));
        }
    return PERI_OK;
}

/* Rows of the points in a block of cells, and where c->weighs their weights: sums->a: as of peri__row_sum_block, sums->n: rows that
   peri__weigh has to look at. */
static void peri__fill_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cloud *c = (const peri__cloud *)context;
    peri__model *m = c->model;
    peri__tally tally[PERI_BLOCK];
    peri__near s;
    for (int64_t cell = begin; cell < end; ++cell)
        for (int32_t p = c->start[cell], last; p < c->start[cell + 1]; p = last) {
            last = (int32_t)peri__min(p + PERI_BLOCK, c->start[cell + 1]);
            peri__look_around(c, cell, &s);
            memset(tally, 0, sizeof tally);
            while (peri__next_near(&s) > 0)
                for (int32_t q = p; q < last; ++q) {
                    const int64_t i = c->order[q];
                    peri__tally *t = &tally[q - p];
                    double x[3];
                    PERI_PREFETCH(&m->start[c->order[peri__min(q + PERI_NEAR_AHEAD, m->points - 1)]]);
                    peri__place_of(c, q, x);
                    const int64_t taken = peri__keep_family(c, &s, peri__take_near(c, &s, x, q), q), at = m->start[i] + t->count;
                    memcpy(&m->ids[at], s.hit, (size_t)taken * sizeof *m->ids);
                    if (c->weighs) peri__weigh_hits(c, &s, i, taken, at, t);
                    t->count += taken;
                }
            for (int32_t q = p; c->weighs && q < last; ++q) sums->n += !peri__is_weighed(c, c->order[q], &tally[q - p], &sums->a);
        }
}

/* Turns the places of row i of the list into ids, ascending. */
static void peri__number_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cloud *c = (const peri__cloud *)context;
    const peri__model *m = c->model;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        int32_t *row = &m->ids[m->start[i]];
        for (int32_t k = 0; k < m->count[i]; ++k) row[k] = c->order[row[k]];
        peri__sort_row(row, m->count[i]);
    }
}

/* Rows of the families that were counted: by places, or where `numbered` by ids. Weights of whole cells are known as soon as lengths are,
   and made on the way where c->weighs: else, and where one of them is amiss, peri__weigh makes them. */
static int32_t peri__write_families(peri_body *b, peri__cloud *c, int numbered) {
    peri__model *m = c->model;
    const int64_t blocks = c->cell_count / PERI_BLOCK + 1;
    m->order = c->order; /* which the model owns from now on, see peri__free_cells */
    if (!peri__make_rows(m)) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    numbered = numbered || m->width > PERI_VECTOR_LIMIT || m->part; /* places depend on the partition */
    c->weighs = !numbered && b->desc.quadrature == PERI_QUADRATURE_FULL && b->desc.influence != PERI_INFLUENCE_USER;
    peri__sums *sums = (peri__sums *)peri__new(&m->memory, blocks, sizeof *sums);
    if (c->weighs) m->weight = peri__new_tail(&m->memory, m->entries, peri__bond_real(b), PERI_GROUP);
    if (!sums || (c->weighs && !m->weight)) {
        peri__delete(&m->memory, sums, blocks, sizeof *sums);
        return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    }
    peri__for_points(b, c->cell_count, 256, peri__fill_block, c, sums);
    for (int64_t k = 0; k * PERI_BLOCK < c->cell_count; ++k) {
        if (sums[k].n > 0) c->weighs = 0;
        if (sums[k].a > m->row_sum) m->row_sum = sums[k].a;
    }
    if (!c->weighs) m->row_sum = 0.0;
    peri__delete(&m->memory, sums, blocks, sizeof *sums);
    if (numbered) {
        m->order = NULL;
        peri__for_points(b, m->points, 4 * m->width, peri__number_block, c, NULL);
    }
    return PERI_OK;
}

typedef struct peri__turner { /* rows by ids on the way to rows by places                                                */
    const peri__cloud *cloud;
    int32_t           *place; /* [points] by id                                                                          */
} peri__turner;

/* Entry k of a row from entry turn[k] & PERI_TURN of what it was. */
#define PERI_TURN (PERI_VECTOR_LIMIT - 1)
static void peri__turn_row(void *array, int64_t first, int64_t count, size_t size, const int64_t *turn) {
    unsigned char was[PERI_VECTOR_LIMIT * 3 * sizeof(double)], *row = (unsigned char *)array + (size_t)first * size;
    memcpy(was, row, (size_t)count * size);
    for (int64_t k = 0; k < count; ++k) memcpy(row + (size_t)k * size, was + (size_t)(turn[k] & PERI_TURN) * size, size);
}

static void peri__turn_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__turner *t = (const peri__turner *)context;
    const peri__model *m = t->cloud->model;
    const size_t real = peri__bond_real(t->cloud->body);
    int64_t turn[PERI_VECTOR_LIMIT];
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        int32_t *row = &m->ids[m->start[i]];
        const int64_t count = m->count[i], first = m->start[i];
        for (int64_t k = 0; k < count; ++k) turn[k] = (int64_t)t->place[row[k]] * PERI_VECTOR_LIMIT + k;
        for (int64_t gap = 40; gap > 0; gap /= 3) /* shell sort */
            for (int64_t a = gap; a < count; ++a) {
                const int64_t moved = turn[a];
                int64_t at = a;
                for (; at >= gap && turn[at - gap] > moved; at -= gap) turn[at] = turn[at - gap];
                turn[at] = moved;
            }
        for (int64_t k = 0; k < count; ++k) row[k] = (int32_t)(turn[k] / PERI_VECTOR_LIMIT);
        peri__turn_row(m->weight, first, count, real, turn);
        if (m->back != m->weight) peri__turn_row(m->back, first, count, real, turn);
        if (m->bond) peri__turn_row(m->bond, first, count, real, turn);
        if (m->partial_volume) peri__turn_row(m->partial_volume, first, count, sizeof *m->partial_volume, turn);
    }
}

/* Turns weighed rows by ids into rows by places, where they fit the room of peri__row. Rules with centroids are never corrected, and so
   never by ids here. */
static int32_t peri__place_rows(peri_body *b, const peri__cloud *c) {
    peri__model *m = c->model;
    if (m->width > PERI_VECTOR_LIMIT) return PERI_OK;
    peri__turner t;
    t.cloud = c;
    t.place = (int32_t *)peri__new(&m->memory, m->points, sizeof *t.place);
    if (!t.place) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    for (int64_t p = 0; p < m->points; ++p) t.place[c->order[p]] = (int32_t)p;
    peri__for_points(b, m->points, 16 * m->width, peri__turn_block, &t, NULL);
    peri__delete(&m->memory, t.place, m->points, sizeof *t.place);
    m->order = c->order;
    return PERI_OK;
}

static int32_t peri__check_families(peri_body *b, const peri__model *m) {
    for (int64_t i = 0; i < m->points; ++i) {
        if (m->count[i] > 0) continue;
        double spacing = pow(m->volume[i], 1.0 / m->dim);
        if (m->horizon * (1.0 + PERI_HORIZON_TOLERANCE) < spacing)
            return peri__fail(b, PERI_ERROR_HORIZON, "horizon", i, spacing * m->length);
        return peri__fail(b, PERI_ERROR_FAMILY, "horizon", i, b->desc.horizon);
    }
    return PERI_OK;
}
