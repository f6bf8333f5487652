/* SPDX-License-Identifier: MIT */
/* sides.c - pairs of adjacent points, and when the bonds between them broke.

   Two points of a bond are adjacent where no other point lies in the ball that has the bond for a diameter (Gabriel's
   neighbours). On lattices these are the points whose cells share a side, in clouds most of those whose Voronoi cells do; in 2D the pairs
   are the edges of a planar graph. What lies on the ball counts as within, so that rounding draws no diagonals. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_ON_THE_BALL 2.5e-4 /* of |xi|^2: 1e-3 of the square of the radius                                            */
#define PERI_UNBROKEN HUGE_VAL  /* the time of a pair whose bond is whole                                                 */

typedef struct peri__sorter { /* scratch for the row of a point                                                           */
    peri__memory memory;
    int64_t  room;
    int32_t *bond;  /* [room] by length                                                                                  */
    double  *square; /* [room] of the length                                                                             */
} peri__sorter;

static void peri__close_sorter(peri__sorter *s) {
    peri__delete(&s->memory, s->bond, s->room, sizeof *s->bond);
    peri__delete(&s->memory, s->square, s->room, sizeof *s->square);
}

static int peri__open_sorter(const peri_body *b, peri__sorter *s) {
    s->memory = b->scratch;
    s->room = b->model->width;
    s->bond = (int32_t *)peri__new(&s->memory, s->room, sizeof *s->bond);
    s->square = (double *)peri__new(&s->memory, s->room, sizeof *s->square);
    if (s->bond && s->square) return 1;
    peri__close_sorter(s);
    return 0;
}

/* The bonds of row i by length: shell sort. */
static void peri__sort_by_length(const peri__model *m, int64_t i, const peri__row *row, peri__sorter *s) {
    static const int64_t gaps[] = { 132, 57, 23, 10, 4, 1 };
    double xi[3];
    for (int64_t k = 0; k < row->count; ++k) {
        peri__bond_of(m, m->f32, i, row->ids[k], xi);
        s->square[k] = peri__dot(xi, xi, m->dim);
        s->bond[k] = (int32_t)k;
    }
    for (int g = 0; g < 6; ++g)
        for (int64_t k = gaps[g]; k < row->count; ++k) {
            const double square = s->square[k];
            const int32_t bond = s->bond[k];
            int64_t at = k;
            for (; at >= gaps[g] && s->square[at - gaps[g]] > square; at -= gaps[g]) {
                s->square[at] = s->square[at - gaps[g]];
                s->bond[at] = s->bond[at - gaps[g]];
            }
            s->square[at] = square;
            s->bond[at] = bond;
        }
}

/* Bonds of row i to the points above `after` that are adjacent to i, ascending by point, to the front of s->bond; returns their number. */
static int64_t peri__sides_of(const peri__model *m, int64_t i, const peri__row *row, int64_t after, peri__sorter *s) {
    int64_t count = 0;
    double xi[3], other[3];
    peri__sort_by_length(m, i, row, s); /* what is in the way of a long bond is mostly near */
    for (int64_t c = row->count - 1; c >= 0; --c) { /* from the longest down: what is written lies behind all that is still asked for */
        int free = row->ids[s->bond[c]] > after;
        peri__bond_of(m, m->f32, i, row->ids[s->bond[c]], xi);
        for (int64_t n = 0; free && n < c; ++n) {
            peri__bond_of(m, m->f32, i, row->ids[s->bond[n]], other);
            free = !(s->square[n] - peri__dot(other, xi, m->dim) < PERI_ON_THE_BALL * s->square[c]);
        }
        if (free) s->bond[row->count - 1 - count++] = s->bond[c];
    }
    for (int64_t n = 0; n < count; ++n) { /* to the front, ascending by point */
        const int32_t k = s->bond[row->count - count + n];
        int64_t at = n;
        for (; at > 0 && row->ids[s->bond[at - 1]] > row->ids[k]; --at) s->bond[at] = s->bond[at - 1];
        s->bond[at] = k;
    }
    return count;
}

/* The same of the points above i, as recorded where they are. */
static int64_t peri__upper_sides_of(const peri_body *b, int64_t i, const peri__row *row, peri__sorter *s) {
    if (!b->side) return peri__sides_of(b->model, i, row, i, s);
    const int64_t first = b->side_start[i], count = b->side_start[i + 1] - first;
    memcpy(s->bond, &b->side[first], (size_t)count * sizeof *s->bond);
    return count;
}

/* ---- when they broke ---------------------------------------------------------------------------------------------- */

/* Notes `time` for what has broken since the last note. */
static void peri__note_breaks(peri_body *b, double time) {
    const peri__model *m = b->model;
    for (int64_t i = 0; b->side_time && i < m->points; ++i)
        for (int64_t n = b->side_start[i]; n < b->side_start[i + 1]; ++n)
            if (b->side_time[n] == PERI_UNBROKEN && !peri__is_alive(b, i, b->side[n])) b->side_time[n] = time;
}

/* After a step that failed, and whose bonds stay broken: they broke at its start, where the body is again. */
static void peri__withdraw_breaks(peri_body *b) {
    for (int64_t n = 0; b->side_time && n < b->side_count; ++n)
        if (b->side_time[n] < PERI_UNBROKEN && b->side_time[n] > peri__load_time(b)) b->side_time[n] = peri__load_time(b);
}

static void peri__note_cuts(peri_body *b, int32_t standing) {
    peri__note_breaks(b, standing == PERI_CUT_INITIAL ? (double)NAN : peri__load_time(b));
}

/* All whole, save what is cut already: of that no time is known. */
static void peri__forget_breaks(peri_body *b) {
    for (int64_t n = 0; b->side_time && n < b->side_count; ++n) b->side_time[n] = PERI_UNBROKEN;
    peri__note_breaks(b, (double)NAN);
}

static void peri__drop_sides(peri_body *b) {
    peri__delete(&b->memory, b->side_start, b->model->points + 1, sizeof *b->side_start);
    peri__delete(&b->memory, b->side, b->side_count, sizeof *b->side);
    peri__delete(&b->memory, b->side_time, b->side_count, sizeof *b->side_time);
    b->side_start = NULL;
    b->side = NULL;
    b->side_time = NULL;
    b->side_count = 0;
}

/* Finds the pairs. 0 where memory is short. */
static int peri__take_sides(peri_body *b) {
    const peri__model *m = b->model;
    peri__sorter s;
    peri__row row;
    if (!peri__open_sorter(b, &s)) return 0;
    b->side_start = (int64_t *)peri__new(&b->memory, m->points + 1, sizeof *b->side_start);
    for (int filling = 0; b->side_start && filling < 2; ++filling) {
        for (int64_t i = 0, n = 0; i < m->points; ++i) {
            peri__read_row(b, i, &row);
            const int64_t count = peri__sides_of(m, i, &row, i, &s);
            if (filling) memcpy(&b->side[n], s.bond, (size_t)count * sizeof *b->side);
            b->side_start[i + 1] = n += count;
        }
        if (filling) break;
        b->side_count = b->side_start[m->points];
        b->side = (int32_t *)peri__new(&b->memory, b->side_count, sizeof *b->side);
        b->side_time = (double *)peri__new(&b->memory, b->side_count, sizeof *b->side_time);
        if (!b->side || !b->side_time) break;
    }
    peri__close_sorter(&s);
    return b->side_start && b->side && b->side_time;
}

PERI_API int32_t peri_record_breaks(peri_body *b, int32_t on) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_FLAG(b, on);
    if (!on) peri__drop_sides(b);
    if (!on || b->side_time) return PERI_OK;
    if (!peri__take_sides(b)) {
        peri__drop_sides(b);
        return peri__fail(b, PERI_ERROR_MEMORY, "peri_record_breaks", -1, 0.0);
    }
    peri__forget_breaks(b);
    return PERI_OK;
}
