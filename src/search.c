/* search.c - which points lie within reach of a point: O(N) for any cloud.

   Points are sorted into the cells of a grid, and the cells follow each other brick by brick, line by line in a brick. The place of a point
   is its rank in this order: points of near places are near in space, whatever their ids. The cells within reach of a cell are few runs of
   places, met in ascending order, so the points found need no sorting. The coordinates in the runs are copied side by side once for all
   points of the cell; the test of a point is then one loop over them, which compilers turn into vector instructions.

   Cells are half the reach wide: 125 of them hold 15.6 cubes of the reach, where 27 cells of its width hold 27; a third of it would leave
   12.7, but makes more runs than points. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_CELL_REACH 2    /* cells that a bond spans at most, per axis                                                  */
#define PERI_BRICK 8         /* cells per edge of a brick                                                                 */
#define PERI_RUNS 50         /* 5 x 5 lines of cells, each in two bricks at most                                          */
#define PERI_NEAR_ROOM 1024  /* points tested at once                                                                     */
#define PERI_NEAR_PIECE 8    /* what copies and vectors move at a time                                                    */
#define PERI_COINCIDENT 1e-24 /* square of the distance below which points are at the same place                          */

typedef struct peri__near { /* what may lie within reach of the points of a cell                                          */
    int32_t run[PERI_RUNS][2];        /* places, ascending; not empty                                                     */
    int32_t runs, at;                 /* at: the run that comes next                                                      */
    int32_t from;                     /* the place in it                                                                  */
    int64_t count;                    /* points at hand:                                                                  */
    int32_t place[PERI_NEAR_ROOM + PERI_NEAR_PIECE];
    double  x[3][PERI_NEAR_ROOM + PERI_NEAR_PIECE];
    double  square[PERI_NEAR_ROOM + PERI_NEAR_PIECE]; /* of the distance from the point asked about                       */
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

/* Chooses the grid and sorts the points into it; within a cell by id. */
static int32_t peri__sort_cells(peri__cloud *c) {
    const peri__model *m = c->model;
    const peri__memory *memory = &m->memory;
    peri__choose_cells(c);
    c->isa = peri__isa(c->body->desc.instructions);
    c->start = (int32_t *)peri__new(memory, c->cell_count + 1, sizeof *c->start);
    c->order = (int32_t *)peri__new(memory, m->points, sizeof *c->order);
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
    const peri__model *m = c->model;
    peri__delete(&m->memory, c->start, c->cell_count + 1, sizeof *c->start);
    if (m->order != c->order) peri__delete(&m->memory, c->order, m->points, sizeof *c->order);
    peri__delete(&m->memory, c->cell, m->points, sizeof *c->cell);
    peri__delete(&m->memory, c->placed, (m->points + PERI_NEAR_PIECE) * m->dim, sizeof *c->placed);
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

/* Takes the next points of the runs; 0 where there are none left. */
static int64_t peri__next_near(const peri__cloud *c, peri__near *s) {
    const int64_t stride = c->model->points + PERI_NEAR_PIECE;
    s->count = 0;
    while (s->at < s->runs && s->count < PERI_NEAR_ROOM) {
        const int32_t from = s->from, take = (int32_t)peri__min(s->run[s->at][1] - from, PERI_NEAR_ROOM - s->count);
        for (int32_t k = 0; k < take; k += PERI_NEAR_PIECE) { /* whole pieces: what is too much is written over or not looked at */
            for (int32_t d = 0; d < c->model->dim; ++d)
                memcpy(&s->x[d][s->count + k], &c->placed[d * stride + from + k], PERI_NEAR_PIECE * sizeof(double));
            for (int32_t n = 0; n < PERI_NEAR_PIECE; ++n) s->place[s->count + k + n] = from + k + n;
        }
        s->count += take;
        s->from += take;
        if (s->from == s->run[s->at][1] && ++s->at < s->runs) s->from = s->run[s->at][0];
    }
    return s->count;
}

/* See peri__measure_near. The squares are the same from either end, to the last bit. */
#define PERI_TEST_NEAR(isa, target)                                                                                    \
    target static int64_t peri__measure_near_##isa(peri__near *s, const double *x, int32_t dim, double reach2, int64_t *same) { \
        PERI_NO_CONTRACTION                                                                                            \
        const int64_t count = s->count;                                                                                \
        const double a = x[0], b = x[1], c = dim == 3 ? x[2] : 0.0;                                                    \
        int64_t within = 0, close = 0;                                                                                 \
        for (int64_t k = 0; k < count; ++k) {                                                                          \
            double square = (s->x[0][k] - a) * (s->x[0][k] - a) + (s->x[1][k] - b) * (s->x[1][k] - b);                 \
            if (dim == 3) square += (s->x[2][k] - c) * (s->x[2][k] - c);                                               \
            s->square[k] = square;                                                                                     \
            within += square <= reach2;                                                                                \
            close += square < PERI_COINCIDENT;                                                                         \
        }                                                                                                              \
        *same += close;                                                                                                \
        return within;                                                                                                 \
    }
PERI_TEST_NEAR(plain, PERI_VECTOR_CODE)
#ifdef PERI_ISA
PERI_TEST_NEAR(avx2, PERI_VECTOR_CODE PERI_TARGET_AVX2)
PERI_TEST_NEAR(avx512, PERI_VECTOR_CODE PERI_TARGET_AVX512)
#endif
#undef PERI_TEST_NEAR

/* Squares of the distances from x of the points at hand. Returns how many are within reach, itself included, and adds to *same those that
   are where x is. */
static int64_t peri__measure_near(const peri__cloud *c, peri__near *s, const double *x, int64_t *same) {
    const int32_t dim = c->model->dim;
#ifdef PERI_ISA
    if (c->isa == 2) return peri__measure_near_avx512(s, x, dim, c->reach2, same);
    if (c->isa == 1) return peri__measure_near_avx2(s, x, dim, c->reach2, same);
#endif
    return peri__measure_near_plain(s, x, dim, c->reach2, same);
}

/* Puts the places of those within reach into hit, all but `own`, and the squares of their distances into length; returns their number. */
static int64_t peri__take_near_plain(peri__near *s, double reach2, int32_t own) {
    int64_t taken = 0;
    for (int64_t k = 0; k < s->count; ++k) { /* without a branch: what is not within reach is written over */
        s->hit[taken] = s->place[k];
        s->length[taken] = s->square[k];
        taken += (s->square[k] <= reach2) & (s->place[k] != own);
    }
    return taken;
}

#ifdef PERI_ISA
PERI_VECTOR_CODE PERI_TARGET_AVX512 static int64_t peri__take_near_avx512(peri__near *s, double reach2, int32_t own) {
    const __m512d reach = _mm512_set1_pd(reach2);
    const __m256i self = _mm256_set1_epi32(own);
    int64_t taken = 0;
    for (int64_t k = 0; k < s->count; k += 8) {
        const __m512d square = _mm512_loadu_pd(s->square + k);
        const __m256i place = _mm256_loadu_si256((const __m256i *)(const void *)(s->place + k));
        const unsigned rest = s->count - k < 8 ? (1u << (s->count - k)) - 1 : 255u;
        const unsigned hit = _mm512_cmp_pd_mask(square, reach, _CMP_LE_OQ) & _mm256_cmpneq_epi32_mask(place, self) & rest;
        _mm256_storeu_si256((__m256i *)(void *)(s->hit + taken), _mm256_maskz_compress_epi32((__mmask8)hit, place));
        _mm512_storeu_pd(s->length + taken, _mm512_maskz_compress_pd((__mmask8)hit, square));
        taken += __builtin_popcount(hit);
    }
    return taken;
}
#endif

static int64_t peri__take_near(const peri__cloud *c, peri__near *s, int32_t own) {
#ifdef PERI_ISA
    if (c->isa == 2) return peri__take_near_avx512(s, c->reach2, own);
#endif
    return peri__take_near_plain(s, c->reach2, own);
}

/* Keeps of the hits those that are in the family of the point at place `own`; the quadrature may want more than the distance. */
static int64_t peri__keep_family(const peri__cloud *c, peri__near *s, int64_t taken, int32_t own) {
    int64_t kept = 0;
    if (c->body->desc.quadrature == PERI_FULL_VOLUME) return taken;
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
    int64_t count = 0, same = 0;
    int32_t own = c->start[cell];
    while (c->order[own] != i) ++own;
    peri__look_around(c, cell, s);
    while (peri__next_near(c, s) > 0) {
        (void)peri__measure_near(c, s, &c->x[i * c->model->dim], &same);
        const int64_t taken = peri__keep_family(c, s, peri__take_near(c, s, own), own);
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
    while (peri__next_near(c, s) > 0) {
        (void)peri__measure_near(c, s, x, &same);
        for (int64_t k = 0; k < s->count; ++k) {
            const int64_t j = c->order[s->place[k]];
            if (s->square[k] < PERI_COINCIDENT && j != i && (twin < 0 || j < twin)) twin = j;
        }
    }
    return twin;
}
