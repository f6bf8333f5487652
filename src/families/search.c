/* SPDX-License-Identifier: MIT */
/* search.c - which points lie within reach of a point: O(N) for any cloud.

   Points are sorted into the cells of a grid, and the cells follow each other brick by brick, line by line in a brick. The place of a point
   is its rank in this order: points of near places are near in space, whatever their ids. The cells within reach of a cell are few runs of
   places, met in ascending order, so the points found need no sorting. Coordinates lie in the order of places, so the test of a point is a
   loop over each run, in vector instructions.

   Cells are half the reach wide: 125 of them hold 15.6 cubes of the reach, where 27 cells of its width hold 27; a third of it would leave
   12.7, but makes more runs than points. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_CELL_REACH 2    /* cells that a bond spans at most, per axis                                                */
#define PERI_BRICK 8         /* cells per edge of a brick                                                                 */
#define PERI_RUNS 50         /* 5 x 5 lines of cells, each in two bricks at most                                          */
#define PERI_NEAR_ROOM 1024  /* points tested at once                                                                     */
#define PERI_NEAR_PIECE 8    /* what vectors read and write at a time, also where fewer are left                          */
#define PERI_COINCIDENT 1e-24 /* square of the distance below which points are at the same place                          */

typedef struct peri__near { /* what may lie within reach of the points of a cell                                          */
    int32_t run[PERI_RUNS][2];        /* places, ascending; not empty                                                     */
    int32_t runs, at;                 /* at: the run that comes next                                                      */
    int32_t from;                     /* the place in it                                                                  */
    int32_t piece[PERI_RUNS][2];      /* the points at hand: parts of runs,                                               */
    int32_t pieces;
    int64_t count;                    /* and how many points                                                              */
    double  square[PERI_NEAR_ROOM + PERI_NEAR_PIECE]; /* of their distances from the point asked about                    */
    int32_t hit[PERI_NEAR_ROOM + PERI_NEAR_PIECE];    /* places of those within reach, and                                */
    double  length[PERI_NEAR_ROOM + PERI_NEAR_PIECE]; /* the squares of their distances                                  */
} peri__near;

/* Cell at `at` in the order of bricks. */
PERI_INLINE int64_t peri__rank_of(const int64_t *cells, const int64_t *at) {
    int64_t brick[3], edge[3];
    for (int d = 0; d < 3; ++d) {
        brick[d] = at[d] / PERI_BRICK * PERI_BRICK;
        edge[d] = peri__min(PERI_BRICK, cells[d] - brick[d]);
    }
    return (cells[1] * brick[2] + brick[1] * edge[2]) * cells[0] + brick[0] * edge[1] * edge[2]
         + ((at[2] - brick[2]) * edge[1] + at[1] - brick[1]) * edge[0] + at[0] - brick[0];
}

/* The inverse. */
static void peri__cell_at(const int64_t *cells, int64_t rank, int64_t *at) {
    int64_t brick[3], edge[3], layer = cells[0] * cells[1];
    brick[2] = rank / (layer * PERI_BRICK) * PERI_BRICK;
    rank -= brick[2] * layer;
    edge[2] = peri__min(PERI_BRICK, cells[2] - brick[2]);
    brick[1] = rank / (cells[0] * edge[2] * PERI_BRICK) * PERI_BRICK;
    rank -= brick[1] * cells[0] * edge[2];
    edge[1] = peri__min(PERI_BRICK, cells[1] - brick[1]);
    brick[0] = rank / (edge[1] * edge[2] * PERI_BRICK) * PERI_BRICK;
    rank -= brick[0] * edge[1] * edge[2];
    edge[0] = peri__min(PERI_BRICK, cells[0] - brick[0]);
    at[0] = brick[0] + rank % edge[0];
    at[1] = brick[1] + rank / edge[0] % edge[1];
    at[2] = brick[2] + rank / (edge[0] * edge[1]);
}

static int64_t peri__cell_of(const peri__cloud *c, const double *x) {
    int64_t at[3] = { 0, 0, 0 };
    for (int32_t d = 0; d < c->model->dim; ++d) {
        double place = (x[d] - c->lo[d]) * c->scale[d];
        at[d] = place > 0.0 ? (int64_t)place : 0;
        if (at[d] >= c->cells[d]) at[d] = c->cells[d] - 1;
    }
    return peri__rank_of(c->cells, at);
}

/* ---- the grid ----------------------------------------------------------------------------------------------------- */

/* Cells per axis over the extent of a cloud: wide enough for the reach, and not many more than points, however thin the cloud, nor than
   32 bits number. Returns their number. */
static int64_t peri__divide(const double *extent, double reach2, int64_t points, int64_t *cells) {
    const double most = 2.0 * (double)points + 64.0 < INT32_MAX ? 2.0 * (double)points + 64.0 : INT32_MAX;
    double edge = sqrt(reach2) * 1.000001 / PERI_CELL_REACH, count;
    for (int32_t d = 0; d < 3; ++d) /* no reach at all, too */
        if (edge < extent[d] / (most + 1.0)) edge = extent[d] / (most + 1.0);
    do {
        count = 1.0;
        for (int32_t d = 0; d < 3; ++d) {
            const double along = floor(extent[d] / edge);
            cells[d] = along >= 1.0 ? (int64_t)along : 1;
            count *= (double)cells[d];
        }
        edge *= 1.25;
    } while (count > most);
    return (int64_t)count;
}

static void peri__choose_cells(peri__cloud *c) {
    const peri__model *m = c->model;
    double hi[3], extent[3] = { 0.0, 0.0, 0.0 };
    for (int32_t d = 0; d < m->dim; ++d) c->lo[d] = hi[d] = c->x[d];
    for (int64_t i = 1; i < m->points; ++i)
        for (int32_t d = 0; d < m->dim; ++d) {
            const double x = c->x[i * m->dim + d];
            if (x < c->lo[d]) c->lo[d] = x;
            if (x > hi[d]) hi[d] = x;
        }
    for (int32_t d = 0; d < m->dim; ++d) extent[d] = hi[d] - c->lo[d];
    c->cell_count = peri__divide(extent, c->reach2, m->points, c->cells);
    for (int32_t d = 0; d < 3; ++d) c->scale[d] = extent[d] > 0.0 ? (double)c->cells[d] / extent[d] : 0.0;
}

static void peri__cells_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cloud *c = (const peri__cloud *)context;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) c->cell[i] = (int32_t)peri__cell_of(c, &c->x[i * c->model->dim]);
}

static void peri__placed_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cloud *c = (const peri__cloud *)context;
    const int32_t dim = c->model->dim;
    (void)sums;
    for (int64_t p = begin; p < end; ++p)
        for (int32_t d = 0; d < dim; ++d) c->placed[d * (c->model->points + PERI_NEAR_PIECE) + p] = c->x[(int64_t)c->order[p] * dim + d];
}

/* The order of the search, where no rows lie in it. */
static void peri__drop_sorted(peri__model *m) {
    if (m->sorted != m->order) peri__delete(&m->memory, m->sorted, m->points, sizeof *m->sorted);
    m->sorted = NULL;
}

/* Chooses the grid and sorts the points into it; within a cell by id. */
static int32_t peri__sort_cells(peri__cloud *c) {
    peri__model *m = c->model;
    const peri__memory *memory = &c->body->scratch;
    peri__choose_cells(c);
    c->isa = peri__isa(c->body->desc.instructions);
    c->start = (int32_t *)peri__new(memory, c->cell_count + 1, sizeof *c->start);
    c->order = m->sorted = (int32_t *)peri__new(&m->memory, m->points, sizeof *c->order);
    c->cell = (int32_t *)peri__new(memory, m->points, sizeof *c->cell);
    if (!c->start || !c->order || !c->cell) return PERI_ERROR_MEMORY;
    peri__for_points(c->body, m->points, 4, peri__cells_block, c, NULL);
    for (int64_t i = 0; i < m->points; ++i) c->start[c->cell[i] + 1]++;
    for (int64_t k = 0; k < c->cell_count; ++k) c->start[k + 1] += c->start[k];
    for (int64_t i = 0; i < m->points; ++i) c->order[c->start[c->cell[i]]++] = (int32_t)i;
    for (int64_t k = c->cell_count; k > 0; --k) c->start[k] = c->start[k - 1];
    c->start[0] = 0;
    peri__delete(memory, c->cell, m->points, sizeof *c->cell);
    c->cell = NULL;
    c->placed = (double *)peri__new(memory, (m->points + PERI_NEAR_PIECE) * m->dim, sizeof *c->placed);
    if (!c->placed) return PERI_ERROR_MEMORY;
    peri__for_points(c->body, m->points, 4, peri__placed_block, c, NULL);
    return PERI_OK;
}

static void peri__free_cells(peri__cloud *c) {
    peri__model *m = c->model;
    const peri__memory *memory = &c->body->scratch;
    peri__delete(memory, c->start, c->cell_count + 1, sizeof *c->start);
    peri__delete(memory, c->cell, m->points, sizeof *c->cell);
    peri__delete(memory, c->placed, (m->points + PERI_NEAR_PIECE) * m->dim, sizeof *c->placed);
    peri__drop_sorted(m);
    c->start = c->order = c->cell = NULL;
    c->placed = NULL;
}

/* ---- the test ----------------------------------------------------------------------------------------------------- */

/* Adds the runs of places in the cells from lo to hi of the brick whose first cell is at b. */
static void peri__look_into(const peri__cloud *c, const int64_t *b, const int64_t *lo, const int64_t *hi, peri__near *s) {
    int64_t from[3], to[3], edge[2];
    for (int d = 0; d < 3; ++d) {
        from[d] = b[d] > lo[d] ? b[d] : lo[d];
        to[d] = peri__min(hi[d], b[d] + PERI_BRICK - 1);
        if (d < 2) edge[d] = peri__min(PERI_BRICK, c->cells[d] - b[d]);
    }
    for (int64_t z = from[2], layer = peri__rank_of(c->cells, from); z <= to[2]; ++z, layer += edge[1] * edge[0])
        for (int64_t y = from[1], line = layer; y <= to[1]; ++y, line += edge[0]) {
            const int32_t begin = c->start[line], end = c->start[line + to[0] - from[0] + 1];
            if (begin == end) continue;
            if (s->runs > 0 && s->run[s->runs - 1][1] == begin) {
                s->run[s->runs - 1][1] = end;
                continue;
            }
            s->run[s->runs][0] = begin;
            s->run[s->runs++][1] = end;
        }
}

/* The runs of places in the cells about a cell. */
static void peri__look_around(const peri__cloud *c, int64_t cell, peri__near *s) {
    int64_t at[3], lo[3], hi[3], b[3];
    peri__cell_at(c->cells, cell, at);
    for (int d = 0; d < 3; ++d) {
        lo[d] = at[d] > PERI_CELL_REACH ? at[d] - PERI_CELL_REACH : 0;
        hi[d] = peri__min(at[d] + PERI_CELL_REACH, c->cells[d] - 1);
    }
    s->runs = s->at = 0;
    for (b[2] = lo[2] / PERI_BRICK * PERI_BRICK; b[2] <= hi[2]; b[2] += PERI_BRICK)
        for (b[1] = lo[1] / PERI_BRICK * PERI_BRICK; b[1] <= hi[1]; b[1] += PERI_BRICK)
            for (b[0] = lo[0] / PERI_BRICK * PERI_BRICK; b[0] <= hi[0]; b[0] += PERI_BRICK)
                peri__look_into(c, b, lo, hi, s);
    s->from = s->run[0][0];
}

/* Takes the next points of the runs, as many as there is room for the squares of; returns their number. */
static int64_t peri__next_near(peri__near *s) {
    s->pieces = 0;
    s->count = 0;
    while (s->at < s->runs && s->count < PERI_NEAR_ROOM) {
        const int32_t take = (int32_t)peri__min(s->run[s->at][1] - s->from, PERI_NEAR_ROOM - s->count);
        s->piece[s->pieces][0] = s->from;
        s->piece[s->pieces++][1] = s->from += take;
        s->count += take;
        if (s->from == s->run[s->at][1] && ++s->at < s->runs) s->from = s->run[s->at][0];
    }
    return s->count;
}

/* Squares of the distances from x of the points at hand, the same from either end to the last bit. Returns how many are within reach, x
   itself included, and adds to *same those that are where x is. */
#define PERI_MEASURE_NEAR(isa, target)                                                                                 \
    target static int64_t peri__measure_near_##isa(const peri__cloud *c, peri__near *s, const double *at, int64_t *same) { \
        PERI_NO_CONTRACTION                                                                                            \
        const int64_t stride = c->model->points + PERI_NEAR_PIECE;                                                     \
        const int solid = c->model->dim == 3;                                                                          \
        const double p = at[0], q = at[1], r = solid ? at[2] : 0.0, reach2 = c->reach2;                                \
        double *out = s->square;                                                                                       \
        int64_t within = 0, close = 0;                                                                                 \
        for (int32_t n = 0; n < s->pieces; ++n) {                                                                      \
            const int32_t count = s->piece[n][1] - s->piece[n][0];                                                     \
            const double *x = c->placed + s->piece[n][0], *y = x + stride, *z = solid ? y + stride : y;                \
            for (int32_t k = 0; k < count; ++k) {                                                                      \
                double square = (x[k] - p) * (x[k] - p) + (y[k] - q) * (y[k] - q);                                     \
                if (solid) square += (z[k] - r) * (z[k] - r);                                                          \
                out[k] = square;                                                                                       \
                within += square <= reach2;                                                                            \
                close += square < PERI_COINCIDENT;                                                                     \
            }                                                                                                          \
            out += count;                                                                                              \
        }                                                                                                              \
        *same += close;                                                                                                \
        return within;                                                                                                 \
    }
PERI_MEASURE_NEAR(plain, PERI_VECTOR_CODE)
#ifdef PERI_ISA
PERI_MEASURE_NEAR(avx2, PERI_VECTOR_CODE PERI_TARGET_AVX2)
#endif
#undef PERI_MEASURE_NEAR

#ifdef PERI_ISA
#define PERI_EIGHT_CODE PERI_VECTOR_CODE PERI_TARGET_AVX512

/* The same for the eight points at places x and on, none of which is kept. Bits of those within reach. */
PERI_EIGHT_CODE PERI_INLINE unsigned peri__eight_near(const double *x, int64_t stride, const __m512d at[3], __m512d reach2, const int solid,
                                                      __m512d *square) {
    PERI_NO_CONTRACTION
    const __m512d a = _mm512_loadu_pd(x) - at[0], b = _mm512_loadu_pd(x + stride) - at[1];
    *square = a * a + b * b;
    if (solid) {
        const __m512d d = _mm512_loadu_pd(x + 2 * stride) - at[2];
        *square = *square + d * d;
    }
    return _mm512_cmp_pd_mask(*square, reach2, _CMP_LE_OQ);
}

/* taking: as peri__take_near; else as peri__measure_near. */
PERI_EIGHT_CODE PERI_INLINE int64_t peri__visit_eights(const peri__cloud *c, peri__near *s, const double *x, int64_t *same, int32_t own,
                                                       const int solid, const int taking) {
    const int64_t stride = c->model->points + PERI_NEAR_PIECE;
    const __m512d reach2 = _mm512_set1_pd(c->reach2), none = _mm512_set1_pd(PERI_COINCIDENT);
    const __m512d at[3] = { _mm512_set1_pd(x[0]), _mm512_set1_pd(x[1]), _mm512_set1_pd(solid ? x[2] : 0.0) };
    const __m256i steps = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    int64_t found = 0, close = 0;
    for (int32_t n = 0; n < s->pieces; ++n)
        for (int32_t p = s->piece[n][0], end = s->piece[n][1]; p < end; p += 8) {
            __m512d square;
            unsigned hit = peri__eight_near(c->placed + p, stride, at, reach2, solid, &square);
            if (end - p < 8) hit &= (1u << (end - p)) - 1;
            if (taking) {
                const __m256i place = _mm256_add_epi32(_mm256_set1_epi32(p), steps);
                if (own - p < 8 && own >= p) hit &= ~(1u << (own - p));
                _mm256_storeu_si256((__m256i *)(void *)(s->hit + found), _mm256_maskz_compress_epi32((__mmask8)hit, place));
                _mm512_storeu_pd(s->length + found, _mm512_maskz_compress_pd((__mmask8)hit, square));
            } else
                close += __builtin_popcount(_mm512_mask_cmp_pd_mask((__mmask8)hit, square, none, _CMP_LT_OQ));
            found += __builtin_popcount(hit);
        }
    *same += close;
    return found;
}

PERI_EIGHT_CODE static int64_t peri__count_near_avx512(const peri__cloud *c, peri__near *s, const double *x, int64_t *same) {
    return c->model->dim == 3 ? peri__visit_eights(c, s, x, same, 0, 1, 0) : peri__visit_eights(c, s, x, same, 0, 0, 0);
}

PERI_EIGHT_CODE static int64_t peri__take_near_avx512(const peri__cloud *c, peri__near *s, const double *x, int32_t own) {
    int64_t same = 0;
    return c->model->dim == 3 ? peri__visit_eights(c, s, x, &same, own, 1, 1) : peri__visit_eights(c, s, x, &same, own, 0, 1);
}
#undef PERI_EIGHT_CODE
#endif

/* As peri__measure_near; may leave the squares alone. */
static int64_t peri__count_near(const peri__cloud *c, peri__near *s, const double *x, int64_t *same) {
#ifdef PERI_ISA
    if (c->isa == 2) return peri__count_near_avx512(c, s, x, same);
    if (c->isa == 1) return peri__measure_near_avx2(c, s, x, same);
#endif
    return peri__measure_near_plain(c, s, x, same);
}

/* Puts the places of those within reach of x into hit, all but `own`, and the squares of their distances into length; returns their
   number. */
static int64_t peri__take_near(const peri__cloud *c, peri__near *s, const double *x, int32_t own) {
    int64_t taken = 0, at = 0;
#ifdef PERI_ISA
    if (c->isa == 2) return peri__take_near_avx512(c, s, x, own);
#endif
    if (peri__count_near(c, s, x, &taken) == 0) return 0;
    taken = 0;
    for (int32_t n = 0; n < s->pieces; ++n)
        for (int32_t p = s->piece[n][0]; p < s->piece[n][1]; ++p, ++at) { /* without a branch: what is not within reach is written over */
            s->hit[taken] = p;
            s->length[taken] = s->square[at];
            taken += (s->square[at] <= c->reach2) & (p != own);
        }
    return taken;
}

/* Keeps of the hits those that are in the family of the point at place `own`; the quadrature may want more than the distance. */
static int64_t peri__keep_family(const peri__cloud *c, peri__near *s, int64_t taken, int32_t own) {
    int64_t kept = 0;
    if (c->body->desc.quadrature == PERI_QUADRATURE_FULL) return taken;
    for (int64_t k = 0; k < taken; ++k) {
        if (!peri__is_family(c, c->order[own], c->order[s->hit[k]])) continue;
        s->hit[kept] = s->hit[k];
        s->length[kept++] = s->length[k];
    }
    return kept;
}

static void peri__place_of(const peri__cloud *c, int64_t place, double *x) {
    for (int32_t d = 0; d < c->model->dim; ++d) x[d] = c->placed[d * (c->model->points + PERI_NEAR_PIECE) + place];
}

/* Row of a point, ids in the order of places: up to `room` of them are written. Returns their number. */
static int64_t peri__visit_family(const peri__cloud *c, int64_t i, peri__near *s, int32_t *row, int64_t room) {
    const int64_t cell = peri__cell_of(c, &c->x[i * c->model->dim]);
    int64_t count = 0;
    int32_t own = c->start[cell];
    while (c->order[own] != i) ++own;
    peri__look_around(c, cell, s);
    while (peri__next_near(s) > 0) {
        const int64_t taken = peri__keep_family(c, s, peri__take_near(c, s, &c->x[i * c->model->dim], own), own);
        for (int64_t k = 0; k < taken && count + k < room; ++k) row[count + k] = c->order[s->hit[k]];
        count += taken;
    }
    return count;
}

/* The least id of another point that is where i is, or -1. */
static int64_t peri__twin_of(const peri__cloud *c, int64_t i, peri__near *s) {
    const double *x = &c->x[i * c->model->dim];
    int64_t twin = -1, same = 0;
    peri__look_around(c, peri__cell_of(c, x), s);
    while (peri__next_near(s) > 0) {
        (void)peri__measure_near_plain(c, s, x, &same);
        const double *square = s->square;
        for (int32_t n = 0; n < s->pieces; ++n)
            for (int32_t p = s->piece[n][0]; p < s->piece[n][1]; ++p) {
                const int64_t j = c->order[p];
                if (*square++ < PERI_COINCIDENT && j != i && (twin < 0 || j < twin)) twin = j;
            }
    }
    return twin;
}
