/* SPDX-License-Identifier: MIT */
/* rows.c - the family of a point, one row of Ibond, wherever it is stored. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Row i from the columns of its group, into the room of `row`. Columns ascend by offset, so ids ascend. */
static void peri__expand_row(const peri__model *m, int64_t i, peri__row *row) {
    const peri__stencil *stencil = &m->stencil;
    const int64_t g = i / PERI_GROUP, columns = stencil->begin[g + 1] - stencil->begin[g];
    const peri__column *column = &stencil->column[stencil->first[g]];
    int64_t n = 0;
    for (int64_t c = 0; c < columns; ++c) {
        const peri__stencil_bond *entry = &stencil->table[column[c].vector];
        if (!(column[c].member >> (i % PERI_GROUP) & 1)) continue;
        row->ids_room[n] = (int32_t)(i + column[c].offset);
        row->partial_volume_room[n] = (float)entry->partial_volume;
        row->vector_room[n] = column[c].vector;
        row->column_room[n] = (int32_t)c;
        if (m->b32) {
            row->bond_room.f32[n] = (float)entry->length;
            row->weight_room.f32[n] = (float)entry->weight;
        } else {
            row->bond_room.f64[n] = entry->length;
            row->weight_room.f64[n] = entry->weight;
        }
        ++n;
    }
    row->count = n;
    row->first = 0;
    row->ids = row->ids_room;
    row->weight = row->back = &row->weight_room;
    row->bond = &row->bond_room;
    row->partial_volume = stencil->partial ? row->partial_volume_room : NULL;
    row->vector = row->vector_room;
    row->column = row->column_room;
    row->table = stencil->table;
}

/* |xi| of the bonds of row i, from the places of points. Seen from either end the same, to the last bit. */
#define PERI_MEASURE(real, room, bond, root)                                                                           \
    const real *x = (const real *)m->x, *y = x + m->stride, *z = m->dim == 3 ? y + m->stride : y;                      \
    const real xi = x[i], yi = y[i], zi = z[i];                                                                        \
    for (int64_t k = 0; k < row->count; ++k) {                                                                         \
        const int32_t j = row->ids[k];                                                                                 \
        real square = (x[j] - xi) * (x[j] - xi) + (y[j] - yi) * (y[j] - yi);                                           \
        if (m->dim == 3) square += (z[j] - zi) * (z[j] - zi);                                                          \
        room[k] = (bond)root(square);                                                                                  \
    }
static void peri__measure_row(const peri__model *m, int64_t i, peri__row *row) {
    if (m->f32) {
        PERI_MEASURE(float, row->bond_room.f32, float, sqrtf)
    } else if (m->b32) {
        PERI_MEASURE(double, row->bond_room.f32, float, sqrt)
    } else {
        PERI_MEASURE(double, row->bond_room.f64, double, sqrt)
    }
    row->bond = &row->bond_room;
}
#undef PERI_MEASURE

/* Row i: ids, and what each bond weighs. Valid while `row` and the model are. */
PERI_SHARED void peri__row_of(const peri__model *m, int64_t i, peri__row *row) {
    const size_t real = m->b32 ? sizeof(float) : sizeof(double);
    if (m->stencil.columns) {
        peri__expand_row(m, i, row);
        return;
    }
    row->count = m->count[i];
    row->first = m->start[i];
    row->ids = &m->ids[row->first];
    if (m->order) {
        for (int64_t k = 0; k < row->count; ++k) row->ids_room[k] = m->order[row->ids[k]];
        row->ids = row->ids_room;
    }
    row->weight = (const char *)m->weight + (size_t)row->first * real;
    row->back = (const char *)m->back + (size_t)row->first * real;
    row->partial_volume = m->partial_volume ? &m->partial_volume[row->first] : NULL;
    row->vector = NULL;
    row->column = NULL;
    if (m->bond) row->bond = (const char *)m->bond + (size_t)row->first * real;
    else peri__measure_row(m, i, row);
}

static void peri__read_row(const peri_body *b, int64_t i, peri__row *row) { peri__row_of(b->model, i, row); }

/* Entry of bond k of row i in the arrays of bonds, ->work. On columns that of its lane in its column. */
PERI_SHARED int64_t peri__bond_slot(const peri__model *m, int64_t i, const peri__row *row, int64_t k) {
    return row->vector ? (m->stencil.begin[i / PERI_GROUP] + row->column[k]) * PERI_GROUP + i % PERI_GROUP : row->first + k;
}

/* And of component d in ->pull. */
PERI_SHARED int64_t peri__pull_slot(const peri__model *m, int64_t slot, int32_t d) {
    if (!m->stencil.columns) return slot * m->dim + d;
    return (slot / PERI_GROUP * m->dim + d) * PERI_GROUP + slot % PERI_GROUP;
}

/* The least critical stretch that a bond of point i may have. */
PERI_SHARED double peri__least_stretch(const peri__operands *s, int64_t i) {
    const peri__pair *pairs = s->point_class ? &s->pairs[s->point_class[i] * s->classes] : s->pairs;
    double least = pairs->s0;
    for (int32_t k = 1; s->point_class && k < s->classes; ++k)
        if (pairs[k].s0 < least) least = pairs[k].s0;
    return least;
}

/* And the least limit of a criterion that a bond of point i may have. */
PERI_SHARED double peri__least_limit(const peri__operands *s, int64_t i, int32_t criterion) {
    const peri__pair *pairs = s->point_class ? &s->pairs[s->point_class[i] * s->classes] : s->pairs;
    double least = pairs->limit[criterion - peri__first_criterion];
    for (int32_t k = 1; s->point_class && k < s->classes; ++k)
        if (pairs[k].limit[criterion - peri__first_criterion] < least) least = pairs[k].limit[criterion - peri__first_criterion];
    return least;
}

/* The bond of the row to the point of least id above `after`, or -1. */
static int64_t peri__next_bond(const peri__row *row, int64_t after) {
    int64_t next = -1;
    for (int64_t k = 0; k < row->count; ++k)
        if (row->ids[k] > after && (next < 0 || row->ids[k] < row->ids[next])) next = k;
    return next;
}

/* Which bond of row i leads to j, or -1. */
PERI_SHARED int64_t peri__find_bond(const peri__model *m, int64_t i, int64_t j) {
    const peri__stencil *stencil = &m->stencil;
    const int64_t g = i / PERI_GROUP;
    int64_t place = 0;
    if (!stencil->columns) return peri__find_listed(m, i, j);
    const peri__column *column = &stencil->column[stencil->first[g]], *end = column + (stencil->begin[g + 1] - stencil->begin[g]);
    for (; column < end && column->offset <= j - i; ++column) {
        const int has = column->member >> (i % PERI_GROUP) & 1;
        if (has && column->offset == j - i) return place;
        place += has;
    }
    return -1;
}

PERI_INLINE int peri__is_alive(const peri_body *b, int64_t i, int64_t k) {
    return !b->alive || (b->alive[i * b->model->words + k / 32] >> (k % 32) & 1);
}

/* Takes out bond k of row i, which is bond `back` of row j. */
static void peri__take_out(const peri_body *b, int64_t i, int64_t k, int64_t j, int64_t back) {
    const int64_t words = b->model->words;
    b->alive[i * words + k / 32] &= ~((uint32_t)1 << (k % 32));
    b->alive[j * words + back / 32] &= ~((uint32_t)1 << (back % 32));
}

PERI_INLINE void peri__bond_of(const peri__model *m, int f32, int64_t i, int64_t j, double *xi) {
    xi[0] = peri__get_real(m->x, f32, j) - peri__get_real(m->x, f32, i);
    xi[1] = peri__get_real(m->x, f32, m->stride + j) - peri__get_real(m->x, f32, m->stride + i);
    if (m->dim == 3) xi[2] = peri__get_real(m->x, f32, 2 * m->stride + j) - peri__get_real(m->x, f32, 2 * m->stride + i);
}

/* Bond (i, j): xi and eta. */
static void peri__pull_of(const peri_body *b, int64_t i, int64_t j, double *xi, double *eta) {
    const peri__model *m = b->model;
    peri__bond_of(m, b->f32, i, j, xi);
    for (int32_t d = 0; d < m->dim; ++d)
        eta[d] = peri__get_real(b->u, b->f32, d * m->stride + j) - peri__get_real(b->u, b->f32, d * m->stride + i);
}

/* Stretch of bond k of point i at the present displacement. */
static double peri__stretch(const peri_body *b, int64_t i, const peri__row *row, int64_t k) {
    const peri__model *m = b->model;
    int64_t at = row->first + k, j = row->ids[k];
    double along = 0.0, square = 0.0, bond = peri__get_real(row->bond, b->b32, k);
    int linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    for (int32_t d = 0; d < m->dim; ++d) {
        double xi = peri__get_real(m->x, b->f32, d * m->stride + j) - peri__get_real(m->x, b->f32, d * m->stride + i);
        double eta = peri__get_real(b->u, b->f32, d * m->stride + j) - peri__get_real(b->u, b->f32, d * m->stride + i);
        if (m->centroid) xi = peri__get_real(m->centroid, b->b32, at * m->dim + d);
        along += linear ? xi * eta : (2.0 * xi + eta) * eta;
        square += peri__square(xi + eta);
    }
    return along / (bond * (linear ? bond : sqrt(square) + bond));
}

/* ---- fields of material, in double ----------------------------------------------------------------------------------- */

PERI_INLINE double peri__field_at(const peri_body *b, const void *field, int64_t i, double without) {
    return field ? peri__get_real(field, b->b32, b->model->margin + i) : without;
}

PERI_INLINE double peri__eigenstrain_at(const peri_body *b, int64_t i) { return peri__field_at(b, b->eigenstrain, i, 0.0); }

PERI_INLINE double peri__stiffness_at(const peri_body *b, int64_t i) { return peri__field_at(b, b->stiffness, i, 1.0); }

/* What the half that end i gives of a bond feels: its own, of a pairwise law the mean of both ends. */
PERI_INLINE double peri__felt_eigenstrain(const peri_body *b, int64_t i, int64_t j) {
    const double own = peri__eigenstrain_at(b, i);
    return b->model->laws[b->model->material[i]].pairwise ? 0.5 * (own + peri__eigenstrain_at(b, j)) : own;
}

/* Of the stiffness of a pairwise bond: its halves act one after the other. */
PERI_INLINE double peri__stiffness_between(const peri_body *b, int64_t i, int64_t j) {
    const double own = peri__stiffness_at(b, i), other = peri__stiffness_at(b, j);
    return b->stiffness ? 2.0 * own * other / (own + other) : 1.0;
}

PERI_INLINE const peri__law *peri__law_at(const peri_body *b, int64_t i, peri__law *room) {
    return peri__stiffened(b->model, i, peri__stiffness_at(b, i), room);
}

PERI_INLINE double peri__density_at(const peri_body *b, int64_t i) {
    return b->density ? b->density[i] : b->model->rho[b->model->material[i]];
}

PERI_INLINE double peri__mass(const peri_body *b, int64_t i) { return peri__density_at(b, i) * b->model->volume[i]; }

/* What criteria see: stretch beyond the mean eigenstrain of the ends. */
static double peri__elastic_stretch(const peri_body *b, int64_t i, const peri__row *row, int64_t k) {
    const double stretch = peri__stretch(b, i, row, k);
    return b->eigenstrain ? stretch - 0.5 * (peri__eigenstrain_at(b, i) + peri__eigenstrain_at(b, row->ids[k])) : stretch;
}

static double peri__strength_of(const peri_body *b, int64_t i, const peri__row *row, int64_t k) {
    const double points = 0.5 * (peri__field_at(b, b->strength, i, 1.0) + peri__field_at(b, b->strength, row->ids[k], 1.0));
    return b->bond_strength ? points * (double)b->bond_strength[peri__bond_slot(b->model, i, row, k)] : points;
}
