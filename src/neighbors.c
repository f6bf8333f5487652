/* neighbors.c - points to families: the array Ibond of [T] 3.11, its rows without padding. Row i holds the ids of the family of i,
   ascending. Found by a grid of cells no smaller than the reach, so in O(N) for any cloud; or checked where the caller gave them. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static int64_t peri__cell_of(const peri__cloud *c, const double *x, int64_t *at) {
    int64_t cell = 0;
    for (int32_t d = c->model->dim - 1; d >= 0; --d) {
        double place = (x[d] - c->lo[d]) * c->scale[d];
        at[d] = place > 0.0 ? (int64_t)place : 0;
        if (at[d] >= c->cells[d]) at[d] = c->cells[d] - 1;
        cell = cell * c->cells[d] + at[d];
    }
    return cell;
}

/* Chooses the grid and sorts the points into it. */
static int32_t peri__sort_cells(peri__cloud *c, const peri__memory *memory) {
    peri__model *m = c->model;
    int32_t dim = m->dim;
    double hi[3], reach = sqrt(c->reach2), cells, edge = reach * 1.000001; /* a bond spans two cells at most */
    int64_t at[3];
    for (int32_t d = 0; d < dim; ++d) {
        c->lo[d] = hi[d] = c->x[d];
        for (int64_t i = 1; i < m->points; ++i) {
            double x = c->x[i * dim + d];
            if (x < c->lo[d]) c->lo[d] = x;
            if (x > hi[d]) hi[d] = x;
        }
    }
    do { /* not many more cells than points, however thin the cloud */
        cells = 1.0;
        for (int32_t d = 0; d < dim; ++d) {
            double count = floor((hi[d] - c->lo[d]) / edge);
            if (count < 1.0) count = 1.0;
            cells *= count;
        }
        edge *= 1.25;
    } while (cells > 2.0 * (double)m->points + 64.0);
    edge /= 1.25;
    c->cell_count = 1;
    for (int32_t d = 0; d < dim; ++d) {
        double count = floor((hi[d] - c->lo[d]) / edge);
        c->cells[d] = count < 1.0 ? 1 : (int64_t)count;
        c->scale[d] = hi[d] > c->lo[d] ? (double)c->cells[d] / (hi[d] - c->lo[d]) : 0.0;
        c->cell_count *= c->cells[d];
    }
    c->start = (int32_t *)peri__new(memory, c->cell_count + 1, sizeof(int32_t));
    c->order = (int32_t *)peri__new(memory, m->points, sizeof(int32_t));
    if (!c->start || !c->order) return PERI_ERROR_MEMORY;
    for (int64_t i = 0; i < m->points; ++i) c->start[peri__cell_of(c, &c->x[i * dim], at) + 1]++;
    for (int64_t k = 0; k < c->cell_count; ++k) c->start[k + 1] += c->start[k];
    for (int64_t i = 0; i < m->points; ++i) c->order[c->start[peri__cell_of(c, &c->x[i * dim], at)]++] = (int32_t)i;
    for (int64_t k = c->cell_count; k > 0; --k) c->start[k] = c->start[k - 1];
    c->start[0] = 0;
    return PERI_OK;
}

/* Visits the family of i: writes up to `room` ids and returns their number, or -1 - j where point j is at the same place. */
static int64_t peri__visit_family(const peri__cloud *c, int64_t i, int32_t *row, int64_t room) {
    const peri__model *m = c->model;
    int32_t dim = m->dim;
    int64_t at[3] = { 0, 0, 0 }, count = 0, lo[3] = { 0, 0, 0 }, hi[3] = { 0, 0, 0 };
    const double *xi = &c->x[i * dim];
    (void)peri__cell_of(c, xi, at);
    for (int32_t d = 0; d < dim; ++d) {
        lo[d] = at[d] > 0 ? at[d] - 1 : 0;
        hi[d] = at[d] + 1 < c->cells[d] ? at[d] + 1 : at[d];
    }
    for (int64_t z = lo[2]; z <= hi[2]; ++z)
        for (int64_t y = lo[1]; y <= hi[1]; ++y) {
            int64_t line = ((dim == 3 ? z * c->cells[1] : 0) + y) * c->cells[0];
            for (int32_t k = c->start[line + lo[0]]; k < c->start[line + hi[0] + 1]; ++k) {
                int64_t j = c->order[k];
                double square = 0.0;
                if (j == i) continue;
                for (int32_t d = 0; d < dim; ++d) square += peri__square(c->x[j * dim + d] - xi[d]);
                if (!(square <= c->reach2)) continue;
                if (square < 1e-24) return -1 - j;
                if (!peri__is_family(c, i, j)) continue;
                if (count < room) row[count] = (int32_t)j;
                count++;
            }
        }
    return count;
}

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

static void peri__count_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri__cloud *c = (peri__cloud *)context;
    for (int64_t i = begin; i < end; ++i) {
        int64_t count = peri__visit_family(c, i, NULL, 0);
        if (count < 0) {
            if (sums->bad < 0) {
                sums->bad = i > -1 - count ? i : -1 - count;
                sums->a = (double)(i > -1 - count ? -1 - count : i);
            }
            count = 0;
        }
        c->model->count[i] = (int32_t)count;
    }
}

#define PERI_BRICK 4 /* cells per edge                                                                                    */

/* Where the points come in no order, neighbours are far apart in memory. Passes over the list then go by bricks of cells. 0 where memory
   is short. */
static int peri__choose_order(const peri__cloud *c) {
    peri__model *m = c->model;
    int64_t jumps = 0, last = 0, at[3], bricks[3], done = 0, *n = at;
    for (int64_t i = 0; i < m->points; ++i) {
        const int64_t cell = peri__cell_of(c, &c->x[i * m->dim], at);
        jumps += cell < last - 1 || cell > last + 1;
        last = cell;
    }
    if (2 * jumps <= m->points) return 1;
    m->order = (int32_t *)peri__new(&m->memory, m->points, sizeof *m->order);
    if (!m->order) return 0;
    for (int32_t d = 0; d < 3; ++d) bricks[d] = d < m->dim ? (c->cells[d] + PERI_BRICK - 1) / PERI_BRICK : 1;
    for (int64_t brick = 0; brick < bricks[0] * bricks[1] * bricks[2]; ++brick)
        for (int64_t cell = 0; cell < PERI_BRICK * PERI_BRICK * PERI_BRICK; ++cell) {
            n[0] = brick % bricks[0] * PERI_BRICK + cell % PERI_BRICK;
            n[1] = brick / bricks[0] % bricks[1] * PERI_BRICK + cell / PERI_BRICK % PERI_BRICK;
            n[2] = brick / (bricks[0] * bricks[1]) * PERI_BRICK + cell / (PERI_BRICK * PERI_BRICK);
            if (n[0] >= c->cells[0] || n[1] >= c->cells[1] || n[2] >= (m->dim == 3 ? c->cells[2] : 1)) continue;
            const int64_t line = ((m->dim == 3 ? n[2] * c->cells[1] : 0) + n[1]) * c->cells[0] + n[0];
            for (int32_t k = c->start[line]; k < c->start[line + 1]; ++k) m->order[done++] = c->order[k];
        }
    return 1;
}

/* The point that comes k-th in passes over the list. */
static int64_t peri__nth(const peri__model *m, int64_t k) { return m->order ? m->order[k] : k; }

static void peri__fill_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri__cloud *c = (peri__cloud *)context;
    peri__model *m = c->model;
    (void)sums;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        int32_t *row = &m->ids[m->start[i]];
        peri__sort_row(row, peri__visit_family(c, i, row, m->count[i]));
    }
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
    m->entries = m->bonds + PERI_LANES;
    m->ids = (int32_t *)peri__new(&m->memory, m->entries, sizeof *m->ids);
    return m->ids != NULL;
}

/* Place of j in row i of the list, or -1. */
static int64_t peri__find_listed(const peri__model *m, int64_t i, int64_t j) {
    const int32_t *row = &m->ids[m->start[i]];
    int64_t lo = 0, hi = m->count[i];
    while (lo < hi) {
        int64_t mid = (lo + hi) / 2;
        if (row[mid] < j) lo = mid + 1;
        else hi = mid;
    }
    return lo < m->count[i] && row[lo] == j ? lo : -1;
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
            if (square < 1e-24) return peri__fail(b, PERI_ERROR_COINCIDENT, "positions", i > j ? i : j, (double)(i > j ? j : i));
        }
    return PERI_OK;
}

/* Makes the cloud ready for peri__visit_family. */
static int32_t peri__sort_cloud(peri_body *b, peri__cloud *c) {
    peri__set_reach(c);
    return peri__sort_cells(c, &c->model->memory) < 0 ? peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0) : PERI_OK;
}

static int32_t peri__find_families(peri_body *b, peri__cloud *c, peri__sums *sums) {
    peri__model *m = c->model;
    peri__for_points(b, m->points, 256, peri__count_block, c, sums);
    for (int64_t k = 0; k < m->blocks; ++k)
        if (sums[k].bad >= 0) return peri__fail(b, PERI_ERROR_COINCIDENT, "positions", sums[k].bad, sums[k].a);
    if (!peri__choose_order(c) || !peri__make_rows(m)) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    peri__for_points(b, m->points, 4 * m->width, peri__fill_block, c, NULL);
    return PERI_OK;
}

static int32_t peri__check_families(peri_body *b, const peri__model *m) {
    for (int64_t i = 0; i < m->points; ++i) {
        double spacing = pow(m->volume[i], 1.0 / m->dim);
        if (m->count[i] > 0) continue;
        if (m->horizon * (1.0 + PERI_HORIZON_TOLERANCE) < spacing)
            return peri__fail(b, PERI_ERROR_HORIZON, "horizon", i, spacing * m->length);
        return peri__fail(b, PERI_ERROR_FAMILY, "horizon", i, b->desc.horizon);
    }
    return PERI_OK;
}
