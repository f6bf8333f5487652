/* SPDX-License-Identifier: MIT */
/* columns.inl - the passes over families by columns (stencil.c): the equations of rows.inl for PERI_GROUP points at once, in pieces of
   PERI_WIDTH by the operations of vector.inl, operation by operation in the same order as by rows, so with the same result. Included per
   precision, dimension and instruction set; PERI_ISA_FN names it. `linear`, ... are constants where these are inlined.

   Points with a bond near its critical stretch are left to the rows. A dead lane may read anything, so its part is left out by a choice;
   columns where all lanes live, which most do, skip that. */

#define PERI_PIECES (PERI_GROUP / PERI_WIDTH)
#define PERI_WHOLE 0xFFFF

typedef struct PERI_ISA_FN(group) { /* the columns of a group, the points of the group, and what they have now           */
    const peri__column *column, *end;
    const uint16_t     *alive; /* masks of the columns from the next on, or NULL                                         */
    const peri__stencil_bond *table;
    const peri_r       *u;     /* [dim][stride] from the first point on                                                  */
    int64_t             stride;
    int                 breaking;
    PERI_STATE          own[PERI_D][PERI_PIECES];
} PERI_ISA_FN(group);

typedef struct PERI_ISA_FN(bond) { /* a column: what its bonds have in common                                            */
    PERI_VECTOR   xi[PERI_D], twice[PERI_D]; /* xi, 2 xi                                                                 */
    peri_b        length, inverse, weight;   /* |xi|, 1/|xi|, w beta V                                                   */
    peri_b        limit;                     /* critical stretch, with a margin                                          */
    const peri__stencil_bond *row;           /* of the table                                                             */
    int64_t       offset;
    uint32_t      mask;
} PERI_ISA_FN(bond);

PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(enter)(PERI_ISA_FN(group) *s, const peri__operands *o, int64_t g, int breaking) {
    const peri__model *m = o->model;
    const peri__stencil *stencil = &m->stencil;
    s->column = &stencil->column[stencil->first[g]];
    s->end = s->column + (stencil->begin[g + 1] - stencil->begin[g]);
    s->alive = o->masks ? &o->masks[stencil->begin[g]] : NULL;
    s->u = (const peri_r *)o->u + g * PERI_GROUP;
    s->table = stencil->table;
    s->stride = m->stride;
    s->breaking = breaking;
    for (int d = 0; d < PERI_D; ++d)
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) s->own[d][n] = PERI_ISA_FN(take)(s->u + d * s->stride + n * PERI_WIDTH);
}

/* The next column with a live bond, or 0. */
PERI_ISA_TARGET PERI_INLINE int PERI_ISA_FN(next)(PERI_ISA_FN(group) *s, PERI_ISA_FN(bond) *bond) {
    PERI_NO_CONTRACTION
    do {
        if (s->column == s->end) return 0;
        bond->mask = s->alive ? *s->alive++ : s->column->member;
        bond->offset = s->column->offset;
        bond->row = &s->table[s->column->vector];
        s->column++;
    } while (bond->mask == 0);
    for (int d = 0; d < PERI_D; ++d) {
        bond->xi[d] = PERI_V(set1)((peri_b)bond->row->xi[d]);
        bond->twice[d] = bond->xi[d] + bond->xi[d];
    }
    bond->length = (peri_b)bond->row->length;
    bond->weight = (peri_b)bond->row->weight;
    bond->inverse = (peri_b)bond->row->inverse;
    bond->limit = (peri_b)(s->breaking ? bond->row->s0 * (1.0 - PERI_NEAR) : PERI_NEVER);
    return 1;
}

/* eta of piece n. */
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(moved)(const PERI_ISA_FN(group) *s, const PERI_ISA_FN(bond) *bond, int n,
                                                        PERI_VECTOR eta[PERI_D]) {
    for (int d = 0; d < PERI_D; ++d)
        eta[d] = PERI_ISA_FN(apart)(s->u + d * s->stride + bond->offset + n * PERI_WIDTH, s->own[d][n]);
}

/* y = xi + eta, or xi; along = (2 xi + eta).eta, or xi.eta. Returns |y|, or |xi|. */
PERI_ISA_TARGET PERI_INLINE PERI_VECTOR PERI_ISA_FN(extend)(const PERI_ISA_FN(bond) *bond, const PERI_VECTOR eta[PERI_D],
                                                                PERI_VECTOR y[PERI_D], PERI_VECTOR *along, const int linear) {
    PERI_NO_CONTRACTION
    PERI_VECTOR square = PERI_V(set1)(0);
    *along = square;
    for (int d = 0; d < PERI_D; ++d) {
        const PERI_VECTOR part = PERI_IF(linear, bond->xi[d], bond->twice[d] + eta[d]) * eta[d];
        y[d] = PERI_IF(linear, bond->xi[d], bond->xi[d] + eta[d]);
        *along = PERI_IF(d == 0, part, *along + part);
        if (!linear) square = PERI_IF(d == 0, y[d] * y[d], square + y[d] * y[d]);
    }
    return PERI_IF(linear, PERI_V(set1)(bond->length), PERI_V(sqrt)(square));
}

/* What the ends of a column are. */
PERI_INLINE const peri__stencil_ends *PERI_ISA_FN(ends)(const peri__operands *o, const PERI_ISA_FN(bond) *bond) {
    return &o->model->stencil.ends[bond->row - o->model->stencil.table];
}

PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(leave)(PERI_STATE sum[PERI_D][PERI_PIECES], peri_r f[PERI_D][PERI_GROUP]) {
    for (int d = 0; d < PERI_D; ++d)
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) PERI_ISA_FN(spread)(&f[d][n * PERI_WIDTH], &sum[d][n]);
}

/* One column of bonds of pairwise laws; c: the micromodulus times w beta V, where linear over |xi|^3. Returns a bit for each point with
   a live bond beyond its limit. */
PERI_ISA_TARGET PERI_INLINE uint32_t PERI_ISA_FN(pairwise_column)(const PERI_ISA_FN(group) *s,
                                                                      const PERI_ISA_FN(bond) *bond, const peri_b c,
                                                             PERI_STATE sum[PERI_D][PERI_PIECES], const int whole, const int linear,
                                                             const int breaking) {
    PERI_NO_CONTRACTION
    const PERI_VECTOR length = PERI_V(set1)(bond->length), weight = PERI_V(set1)(c), tiny = PERI_V(set1)((peri_b)PERI_TINY);
    const PERI_VECTOR most = PERI_V(set1)(bond->limit * bond->length);
    uint32_t hit = 0;
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
        const PERI_LIVE live = PERI_TO_LIVE(bond->mask >> (n * PERI_WIDTH));
        PERI_VECTOR eta[PERI_D], y[PERI_D], along;
        PERI_ISA_FN(moved)(s, bond, n, eta);
        const PERI_VECTOR now = PERI_ISA_FN(extend)(bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
        const PERI_VECTOR scale = PERI_IF(linear, weight * along, weight * along / (reach * length * (now + tiny)));
        if (breaking) hit |= (uint32_t)PERI_ABOVE(along, most * reach, live) << (n * PERI_WIDTH);
        for (int d = 0; d < PERI_D; ++d) {
            PERI_ISA_FN(gather)(&sum[d][n], PERI_IF(whole, scale * y[d], PERI_KEEP_PRODUCT(live, scale, y[d])));
        }
    }
    return hit;
}

/* Adds the force of all live bonds of group g to f[PERI_D][PERI_GROUP]. Returns a bit for each point with a live bond so near its critical
   stretch that the row must decide. */
PERI_ISA_TARGET PERI_INLINE uint32_t PERI_ISA_FN(pairwise_of)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP],
                                                               const int linear, const int breaking) {
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    uint32_t hit = 0;
    PERI_ISA_FN(enter)(&s, o, g, o->breaking);
    for (int d = 0; d < PERI_D; ++d)
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_ISA_FN(next)(&s, &bond)) {
        peri_b c = (peri_b)bond.row->c * bond.weight;
        if (linear) c *= bond.inverse * bond.inverse * bond.inverse;
        if (!PERI_FREE_CHOICE && bond.mask == PERI_WHOLE) hit |= PERI_ISA_FN(pairwise_column)(&s, &bond, c, sum, 1, linear, breaking);
        else hit |= PERI_ISA_FN(pairwise_column)(&s, &bond, c, sum, 0, linear, breaking);
    }
    PERI_ISA_FN(leave)(sum, f);
    return hit;
}

PERI_ISA_TARGET static uint32_t PERI_ISA_FN(pairwise)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP]) {
    if (PERI_COMPACT) return PERI_ISA_FN(pairwise_of)(o, g, f, o->linear, 1);
    return o->linear ? PERI_ISA_FN(pairwise_of)(o, g, f, 1, o->breaking) : PERI_ISA_FN(pairwise_of)(o, g, f, 0, 1);
}

PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(dilatation_sum_column)(const PERI_ISA_FN(group) *s, const PERI_ISA_FN(bond) *bond,
                                                                   peri_b gauged, PERI_STATE sum[PERI_PIECES], const int whole,
                                                                   const int linear) {
    PERI_NO_CONTRACTION
    const PERI_VECTOR length = PERI_V(set1)(bond->length), weight = PERI_V(set1)(gauged);
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
        PERI_VECTOR eta[PERI_D], y[PERI_D], along;
        PERI_ISA_FN(moved)(s, bond, n, eta);
        const PERI_VECTOR now = PERI_ISA_FN(extend)(bond, eta, y, &along, linear);
        const PERI_VECTOR extension = PERI_IF(linear, along, along / (now + length));
        const PERI_LIVE live = PERI_TO_LIVE(bond->mask >> (n * PERI_WIDTH));
        PERI_ISA_FN(gather)(&sum[n], PERI_IF(whole, weight * extension, PERI_KEEP_PRODUCT(live, weight, extension)));
    }
}

/* sum w g e V of the points of group g to out; g of each column, 0 where its points gather nothing. */
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(dilatation_sum_of)(const peri__operands *o, int64_t g, peri_r out[PERI_GROUP],
                                                               const int linear) {
    const int by_length = o->model->gauge;
    const peri_r none[PERI_GROUP] = { 0 };
    PERI_STATE sum[PERI_PIECES];
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    PERI_ISA_FN(enter)(&s, o, g, 0);
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[n] = PERI_ISA_FN(take)(none + n * PERI_WIDTH);
    while (PERI_ISA_FN(next)(&s, &bond)) {
        peri_b weight = bond.weight * (linear ? (by_length ? 1 : bond.inverse) : by_length ? bond.length : 1);
        if (o->model->mixed) weight = bond.weight * (peri_b)PERI_ISA_FN(ends)(o, &bond)->gauge * (linear ? bond.inverse : 1);
        if (!PERI_FREE_CHOICE && bond.mask == PERI_WHOLE) PERI_ISA_FN(dilatation_sum_column)(&s, &bond, weight, sum, 1, linear);
        else PERI_ISA_FN(dilatation_sum_column)(&s, &bond, weight, sum, 0, linear);
    }
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) PERI_ISA_FN(spread)(out + n * PERI_WIDTH, &sum[n]);
}

PERI_ISA_TARGET static void PERI_ISA_FN(dilatation_sum)(const peri__operands *o, int64_t g, peri_r sum[PERI_GROUP]) {
    if (PERI_COMPACT) PERI_ISA_FN(dilatation_sum_of)(o, g, sum, o->linear);
    else if (o->linear) PERI_ISA_FN(dilatation_sum_of)(o, g, sum, 1);
    else PERI_ISA_FN(dilatation_sum_of)(o, g, sum, 0);
}

/* sum w e^2 V of the points of group g to out, with pairwise laws times c/|xi|: in double whatever the precision. */
PERI_ISA_TARGET static void PERI_ISA_FN(squares)(const peri__operands *o, int64_t g, double out[PERI_GROUP]) {
    PERI_NO_CONTRACTION
    const int linear = o->linear, pairwise = o->model->pairwise;
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    PERI_ISA_FN(enter)(&s, o, g, 0);
    for (int l = 0; l < PERI_GROUP; ++l) out[l] = 0.0;
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const double weight = pairwise ? bond.row->c * (double)bond.weight / (double)bond.length : (double)bond.weight;
        const PERI_VECTOR length = PERI_V(set1)(bond.length);
        peri_b e[PERI_GROUP];
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            PERI_VECTOR eta[PERI_D], y[PERI_D], along;
            PERI_ISA_FN(moved)(&s, &bond, n, eta);
            const PERI_VECTOR now = PERI_ISA_FN(extend)(&bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
            PERI_V(storeu)(e + n * PERI_WIDTH, PERI_KEEP(PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH)), along / reach));
        }
        for (int l = 0; l < PERI_GROUP; ++l) out[l] += weight * ((double)e[l] * (double)e[l]);
    }
}

/* The least stretch of the live bonds of the points of group g to out, HUGE_VAL where there are none: quotients in double. */
PERI_ISA_TARGET static void PERI_ISA_FN(least)(const peri__operands *o, int64_t g, double out[PERI_GROUP]) {
    PERI_NO_CONTRACTION
    const int linear = o->linear;
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    PERI_ISA_FN(enter)(&s, o, g, 0);
    for (int l = 0; l < PERI_GROUP; ++l) out[l] = HUGE_VAL;
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const PERI_VECTOR length = PERI_V(set1)(bond.length);
        const double rest = (double)bond.length;
        peri_b extended[PERI_GROUP], reached[PERI_GROUP];
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            PERI_VECTOR eta[PERI_D], y[PERI_D], along;
            PERI_ISA_FN(moved)(&s, &bond, n, eta);
            const PERI_VECTOR now = PERI_ISA_FN(extend)(&bond, eta, y, &along, linear);
            PERI_V(storeu)(extended + n * PERI_WIDTH, along);
            PERI_V(storeu)(reached + n * PERI_WIDTH, PERI_IF(linear, length, now + length));
        }
        for (int l = 0; l < PERI_GROUP; ++l) {
            const double stretch = (double)extended[l] / ((double)reached[l] * rest);
            out[l] = ((int)(bond.mask >> l & 1) & (stretch < out[l])) ? stretch : out[l];
        }
    }
}

/* One column of bonds of ordinary laws that are alike; p, q: of the points of the group; weighed = w beta V, where linear over |xi|^2;
   gauged = |xi|, or 1. */
PERI_ISA_TARGET PERI_INLINE uint32_t PERI_ISA_FN(ordinary_column)(const PERI_ISA_FN(group) *s, const PERI_ISA_FN(bond) *bond,
                                                                   const peri_b *p, const peri_b *q, peri_b weighed, peri_b gauged,
                                                                   PERI_STATE sum[PERI_D][PERI_PIECES], const int whole, const int linear,
                                                                   const int breaking) {
    PERI_NO_CONTRACTION
    const PERI_VECTOR length = PERI_V(set1)(bond->length), weight = PERI_V(set1)(weighed), gauge = PERI_V(set1)(gauged);
    const PERI_VECTOR most = PERI_V(set1)(bond->limit * bond->length), tiny = PERI_V(set1)((peri_b)PERI_TINY);
    uint32_t hit = 0;
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
        const PERI_LIVE live = PERI_TO_LIVE(bond->mask >> (n * PERI_WIDTH));
        const PERI_VECTOR both_p = PERI_V(loadu)(p + n * PERI_WIDTH) + PERI_V(loadu)(p + bond->offset + n * PERI_WIDTH);
        const PERI_VECTOR both_q = PERI_V(loadu)(q + n * PERI_WIDTH) + PERI_V(loadu)(q + bond->offset + n * PERI_WIDTH);
        PERI_VECTOR eta[PERI_D], y[PERI_D], along;
        PERI_ISA_FN(moved)(s, bond, n, eta);
        const PERI_VECTOR now = PERI_ISA_FN(extend)(bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
        const PERI_VECTOR pull = weight * (both_q * along + both_p * gauge * reach);
        const PERI_VECTOR scale = PERI_IF(linear, pull, pull / (reach * (now + tiny)));
        if (breaking) hit |= (uint32_t)PERI_ABOVE(along, most * reach, live) << (n * PERI_WIDTH);
        for (int d = 0; d < PERI_D; ++d) {
            PERI_ISA_FN(gather)(&sum[d][n], PERI_IF(whole, scale * y[d], PERI_KEEP_PRODUCT(live, scale, y[d])));
        }
    }
    return hit;
}

/* Adds the force of all live bonds of ordinary laws of group g to f. Returns as `pairwise`. */
PERI_ISA_TARGET PERI_INLINE uint32_t PERI_ISA_FN(ordinary_of)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP],
                                                               const int linear, const int breaking) {
    const peri__model *m = o->model;
    const peri_b *p = (const peri_b *)o->response + g * PERI_GROUP;
    const peri_b *q = (const peri_b *)o->constant + PERI__SPRING * m->stride + g * PERI_GROUP;
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    uint32_t hit = 0;
    PERI_ISA_FN(enter)(&s, o, g, o->breaking);
    for (int d = 0; d < PERI_D; ++d)
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const peri_b gauge = m->gauge ? bond.length : 1;
        const peri_b weight = linear ? bond.weight * (bond.inverse * bond.inverse) : bond.weight;
        if (!PERI_FREE_CHOICE && bond.mask == PERI_WHOLE)
            hit |= PERI_ISA_FN(ordinary_column)(&s, &bond, p, q, weight, gauge, sum, 1, linear, breaking);
        else hit |= PERI_ISA_FN(ordinary_column)(&s, &bond, p, q, weight, gauge, sum, 0, linear, breaking);
    }
    PERI_ISA_FN(leave)(sum, f);
    return hit;
}

PERI_ISA_TARGET static uint32_t PERI_ISA_FN(ordinary)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP]) {
    if (PERI_COMPACT) return PERI_ISA_FN(ordinary_of)(o, g, f, o->linear, 1);
    return o->linear ? PERI_ISA_FN(ordinary_of)(o, g, f, 1, o->breaking) : PERI_ISA_FN(ordinary_of)(o, g, f, 0, 1);
}

/* sum w eta xi V. */
PERI_ISA_TARGET static void PERI_ISA_FN(shape)(const peri__operands *o, int64_t g, peri_r out[PERI_D][PERI_D][PERI_GROUP]) {
    PERI_NO_CONTRACTION
    const peri_r none[PERI_GROUP] = { 0 };
    PERI_STATE sum[PERI_D][PERI_D][PERI_PIECES];
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    PERI_ISA_FN(enter)(&s, o, g, 0);
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d)
            PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[a][d][n] = PERI_ISA_FN(take)(none + n * PERI_WIDTH);
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const PERI_VECTOR weight = PERI_V(set1)(bond.weight);
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const PERI_LIVE live = PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH));
            PERI_VECTOR eta[PERI_D];
            PERI_ISA_FN(moved)(&s, &bond, n, eta);
            for (int a = 0; a < PERI_D; ++a) {
                const PERI_VECTOR pulled = PERI_KEEP_PRODUCT(live, weight, eta[a]);
                for (int d = 0; d < PERI_D; ++d) PERI_ISA_FN(gather)(&sum[a][d][n], pulled * bond.xi[d]);
            }
        }
    }
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d)
            PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) PERI_ISA_FN(spread)(&out[a][d][n * PERI_WIDTH], &sum[a][d][n]);
}

/* sum w |eta - H xi|^2 V of the points of group g to out; the sum in double. */
PERI_ISA_TARGET static void PERI_ISA_FN(misfit)(const peri__operands *o, int64_t g, peri_r h[PERI_D][PERI_D][PERI_GROUP],
                                                double out[PERI_GROUP]) {
    PERI_NO_CONTRACTION
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    PERI_ISA_FN(enter)(&s, o, g, 0);
    for (int l = 0; l < PERI_GROUP; ++l) out[l] = 0.0;
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const double weight = (double)bond.weight;
        peri_b xi[PERI_D];
        for (int d = 0; d < PERI_D; ++d) xi[d] = (peri_b)bond.row->xi[d];
        for (int a = 0; a < PERI_D; ++a) {
            const peri_r *own = s.u + a * s.stride, *other = own + bond.offset;
            for (int l = 0; l < PERI_GROUP; ++l) {
                peri_r z = (peri_b)(other[l] - own[l]);
                for (int d = 0; d < PERI_D; ++d) z -= h[a][d][l] * xi[d];
                out[l] += bond.mask >> l & 1 ? weight * ((double)z * (double)z) : 0.0;
            }
        }
    }
}

/* Adds what gradients give of the force of all live bonds of a group to f, w ((Q_i + Q_j) xi + (k_i + k_j) eta). Returns as
   `pairwise`; critical are (2 xi + eta).eta > s0 (2 + s0) |xi|^2, or xi.eta > s0 |xi|^2. */
PERI_ISA_TARGET static uint32_t PERI_ISA_FN(tensor)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP]) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const peri_b *q = (const peri_b *)o->response + m->stride + g * PERI_GROUP;
    const peri_b *k = (const peri_b *)o->constant + PERI__STABILIZATION * m->stride + g * PERI_GROUP;
    const int linear = o->linear;
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    uint32_t hit = 0;
    PERI_ISA_FN(enter)(&s, o, g, o->breaking);
    for (int d = 0; d < PERI_D; ++d)
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const PERI_VECTOR weight = PERI_V(set1)(bond.weight);
        const peri_b most = linear ? bond.limit : bond.limit * (2 + bond.limit);
        const PERI_VECTOR limit = PERI_V(set1)(most * bond.length * bond.length); /* infinite where none breaks */
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const PERI_LIVE live = PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH));
            const peri_b *const here = q + n * PERI_WIDTH, *const there = here + bond.offset;
            const PERI_VECTOR both = PERI_V(loadu)(k + n * PERI_WIDTH) + PERI_V(loadu)(k + bond.offset + n * PERI_WIDTH);
            PERI_VECTOR eta[PERI_D], y[PERI_D], along = PERI_V(set1)(0);
            PERI_ISA_FN(moved)(&s, &bond, n, eta);
            for (int a = 0; a < PERI_D; ++a) {
                y[a] = both * eta[a];
                for (int d = 0; d < PERI_D; ++d) {
                    const int64_t plane = (a * PERI_D + d) * m->stride;
                    y[a] += (PERI_V(loadu)(here + plane) + PERI_V(loadu)(there + plane)) * bond.xi[d];
                }
                along += PERI_IF(linear, bond.xi[a], bond.twice[a] + eta[a]) * eta[a];
            }
            hit |= (uint32_t)PERI_ABOVE(along, limit, live) << (n * PERI_WIDTH);
            for (int a = 0; a < PERI_D; ++a) PERI_ISA_FN(gather)(&sum[a][n], PERI_KEEP_PRODUCT(live, weight, y[a]));
        }
    }
    PERI_ISA_FN(leave)(sum, f);
    return hit;
}

/* ---- laws that differ, energy criteria --------------------------------------------------------------------------- */

/* The work of the forces of a column along the way since they were last worked out, by the trapezoidal rule. Returns a bit for each point
   with a bond whose work comes near its limit. */
PERI_ISA_TARGET PERI_INLINE uint32_t PERI_ISA_FN(work)(const peri__operands *o, int64_t g, const PERI_ISA_FN(group) *s,
                                                           const PERI_ISA_FN(bond) *bond, int64_t column,
                                                           peri_b force[PERI_D][PERI_GROUP]) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t at = (m->stencil.begin[g] + column) * PERI_GROUP;
    const peri_r *worked = (const peri_r *)o->worked + g * PERI_GROUP;
    const peri_r *portion = PERI_MUTUAL(m) ? (const peri_r *)m->portion + g * PERI_GROUP : NULL;
    peri_r *work = (peri_r *)o->work + at, *pull = (peri_r *)o->pull + at * PERI_D;
    const double most = PERI_ISA_FN(ends)(o, bond)->energy * (o->least_strength * o->least_strength);
    const peri_r limit = (peri_r)(o->breaking ? most * (1.0 - PERI_NEAR) : PERI_NEVER);
    const peri_r *here = s->u;
    peri_r done[PERI_GROUP] = { 0 };
    uint32_t hit = 0;
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_GROUP; ++l) {
            const int64_t own = d * m->stride + l, other = own + bond->offset;
            const peri_b eta = (peri_b)(here[other] - here[own]);
            const peri_r way = (peri_r)eta - (worked[other] - worked[own]);
            const peri_r now = PERI_MUTUAL(m) ? portion[l] * force[d][l] : force[d][l];
            done[l] += (peri_r)0.5 * (pull[d * PERI_GROUP + l] + now) * way;
            pull[d * PERI_GROUP + l] = now;
        }
    for (int l = 0; l < PERI_GROUP; ++l) {
        work[l] = bond->mask >> l & 1 ? work[l] + done[l] : work[l];
        hit |= (uint32_t)(work[l] > limit && bond->mask >> l & 1) << l;
    }
    return hit;
}

/* Adds the force of all live bonds of group g to f, whatever the laws of their ends, and counts the work on them where that is asked for.
   Returns as `pairwise`, with a bit for points whose bonds may meet an energy criterion, too. */
PERI_ISA_TARGET static uint32_t PERI_ISA_FN(mixed)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP]) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const peri_b *p = (const peri_b *)o->response + g * PERI_GROUP;
    const peri_b *q = (const peri_b *)o->constant + PERI__SPRING * m->stride + g * PERI_GROUP;
    const peri_b *tensor = (const peri_b *)o->response + m->stride + g * PERI_GROUP;
    const peri_b *k = (const peri_b *)o->constant + PERI__STABILIZATION * m->stride + g * PERI_GROUP;
    const PERI_VECTOR tiny = PERI_V(set1)((peri_b)PERI_TINY);
    const int linear = o->linear, tensors = m->gathers & PERI__GRADIENT;
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    uint32_t hit = 0;
    PERI_ISA_FN(enter)(&s, o, g, o->breaking);
    const peri__column *const first = s.column;
    for (int d = 0; d < PERI_D; ++d)
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const peri__stencil_ends *ends = PERI_ISA_FN(ends)(o, &bond);
        const PERI_VECTOR length = PERI_V(set1)(bond.length), weight = PERI_V(set1)(bond.weight);
        const PERI_VECTOR gauge = PERI_V(set1)((peri_b)ends->gauge), other = PERI_V(set1)((peri_b)ends->other_gauge);
        const PERI_VECTOR spring = PERI_V(set1)((peri_b)ends->spring), most = PERI_V(set1)(bond.limit * bond.length);
        peri_b force[PERI_D][PERI_GROUP];
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) {
            const PERI_LIVE live = PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH));
            const PERI_VECTOR both_p = gauge * PERI_V(loadu)(p + n * PERI_WIDTH) + other * PERI_V(loadu)(p + bond.offset + n * PERI_WIDTH);
            const PERI_VECTOR both_q = PERI_V(loadu)(q + n * PERI_WIDTH) + PERI_V(loadu)(q + bond.offset + n * PERI_WIDTH) + spring;
            PERI_VECTOR eta[PERI_D], y[PERI_D], along;
            PERI_ISA_FN(moved)(&s, &bond, n, eta);
            const PERI_VECTOR now = PERI_ISA_FN(extend)(&bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
            const PERI_VECTOR scale = weight * (both_q * along + both_p * reach) / (reach * (now + tiny));
            hit |= (uint32_t)PERI_ABOVE(along, most * reach, live) << (n * PERI_WIDTH);
            for (int a = 0; a < PERI_D; ++a) {
                PERI_VECTOR all = scale * y[a];
                if (tensors) {
                    const int64_t there = bond.offset + n * PERI_WIDTH;
                    PERI_VECTOR t = (PERI_V(loadu)(k + n * PERI_WIDTH) + PERI_V(loadu)(k + there)) * eta[a];
                    for (int d = 0; d < PERI_D; ++d) {
                        const peri_b *plane = tensor + (a * PERI_D + d) * m->stride;
                        t += (PERI_V(loadu)(plane + n * PERI_WIDTH) + PERI_V(loadu)(plane + there)) * bond.xi[d];
                    }
                    all += weight * t;
                }
                const PERI_VECTOR part = PERI_KEEP(live, all);
                if (o->working) PERI_V(storeu)(&force[a][n * PERI_WIDTH], part);
                PERI_ISA_FN(gather)(&sum[a][n], part);
            }
        }
        if (o->working) hit |= PERI_ISA_FN(work)(o, g, &s, &bond, s.column - first - 1, force);
    }
    PERI_ISA_FN(leave)(sum, f);
    return hit;
}

/* ---- fields of material ------------------------------------------------------------------------------------------ */

typedef struct PERI_ISA_FN(half) { /* what an end of a column gives along the bond is q e + p g                          */
    const peri_b *p, *q, *eigenstrain, *strength, *stiffness; /* of the point of the first lane, or NULL                  */
    peri_b        spring, gauge;                              /* of a pairwise law c/(2 |xi|), else 0; of others g        */
} PERI_ISA_FN(half);

/* The arrays of ends `offset` further on than the first point of group g. */
PERI_INLINE void PERI_ISA_FN(see_half)(const peri__operands *o, int64_t g, int64_t offset, PERI_ISA_FN(half) *half) {
    const int64_t at = g * PERI_GROUP + offset;
    const peri_b *constant = (const peri_b *)o->constant;
    half->p = constant ? (const peri_b *)o->response + at : NULL;
    half->q = constant ? constant + PERI__SPRING * o->model->stride + at : NULL;
    half->eigenstrain = o->eigenstrain ? (const peri_b *)o->eigenstrain + at : NULL;
    half->strength = o->strength ? (const peri_b *)o->strength + at : NULL;
    half->stiffness = o->stiffness ? (const peri_b *)o->stiffness + at : NULL;
}

/* Springs and gauges of both ends of a column. */
PERI_INLINE void PERI_ISA_FN(tell_halves)(const peri__operands *o, const PERI_ISA_FN(bond) *bond, PERI_ISA_FN(half) half[2]) {
    const peri__model *m = o->model;
    const peri_b gauge = m->pairwise ? 0 : m->gauge ? bond->length : 1;
    peri_b spring = (peri_b)(0.5 * bond->row->c) / bond->length;
    half[0].gauge = half[1].gauge = gauge;
    if (m->stencil.ends) {
        const peri__stencil_ends *ends = PERI_ISA_FN(ends)(o, bond);
        half[0].gauge = (peri_b)ends->gauge;
        half[1].gauge = (peri_b)ends->other_gauge;
        spring = (peri_b)(half[0].gauge == half[1].gauge ? 0.5 * ends->spring : ends->spring);
    }
    for (int n = 0; n < 2; ++n) half[n].spring = half[n].gauge == 0 ? spring : 0;
}

/* q e + p g of one end, of piece n; shift: the mean eigenstrain less its own, times |xi| reach, of laws that feel their own. */
PERI_ISA_TARGET PERI_INLINE PERI_VECTOR PERI_ISA_FN(half_pull)(const PERI_ISA_FN(half) *half, int n, const PERI_VECTOR between,
                                                                   const PERI_VECTOR along, const PERI_VECTOR shift,
                                                                   const PERI_VECTOR reach) {
    PERI_NO_CONTRACTION
    if (half->gauge == 0) return (PERI_VECTOR)(PERI_V(set1)(half->spring) * between * along);
    return (PERI_VECTOR)(PERI_V(loadu)(half->q + n * PERI_WIDTH) * (along + shift)
                         + PERI_V(loadu)(half->p + n * PERI_WIDTH) * PERI_V(set1)(half->gauge) * reach);
}

/* Adds the force of all live bonds of group g to f, by the fields of material, whatever the laws of the ends; work as `mixed`. Returns
   as that. */
PERI_ISA_TARGET static uint32_t PERI_ISA_FN(fielded)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP]) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int linear = o->linear, tensors = m->gathers & PERI__GRADIENT;
    const peri_b *tensor = tensors ? (const peri_b *)o->response + m->stride + g * PERI_GROUP : NULL;
    const peri_b *k = tensors ? (const peri_b *)o->constant + PERI__STABILIZATION * m->stride + g * PERI_GROUP : NULL;
    const PERI_VECTOR tiny = PERI_V(set1)((peri_b)PERI_TINY), one = PERI_V(set1)(1), middle = PERI_V(set1)((peri_b)0.5);
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_ISA_FN(group) s;
    PERI_ISA_FN(bond) bond;
    PERI_ISA_FN(half) half[2];
    uint32_t hit = 0;
    PERI_ISA_FN(enter)(&s, o, g, o->breaking);
    PERI_ISA_FN(see_half)(o, g, 0, &half[0]);
    const peri__column *const first = s.column;
    for (int d = 0; d < PERI_D; ++d)
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_ISA_FN(next)(&s, &bond)) {
        const int64_t column = s.column - first - 1;
        const float *bonds = o->bond_strength ? o->bond_strength + (m->stencil.begin[g] + column) * PERI_GROUP : NULL;
        const PERI_VECTOR length = PERI_V(set1)(bond.length), weight = PERI_V(set1)(bond.weight);
        const PERI_VECTOR limit = PERI_V(set1)(bond.limit);
        peri_b force[PERI_D][PERI_GROUP], by_bond[PERI_GROUP];
        for (int l = 0; bonds && l < PERI_GROUP; ++l) by_bond[l] = (peri_b)bonds[l];
        PERI_ISA_FN(see_half)(o, g, bond.offset, &half[1]);
        PERI_ISA_FN(tell_halves)(o, &bond, half);
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) {
            const PERI_LIVE live = PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH));
            PERI_VECTOR eta[PERI_D], y[PERI_D], along, shift[2], strength = one, between = one;
            PERI_ISA_FN(moved)(&s, &bond, n, eta);
            const PERI_VECTOR now = PERI_ISA_FN(extend)(&bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
            const PERI_VECTOR most = length * reach;
            shift[0] = shift[1] = PERI_V(set1)(0);
            if (o->eigenstrain) {
                const PERI_VECTOR own = PERI_V(loadu)(half[0].eigenstrain + n * PERI_WIDTH);
                const PERI_VECTOR other = PERI_V(loadu)(half[1].eigenstrain + n * PERI_WIDTH), mean = middle * (own + other);
                along -= mean * most;
                shift[0] = (mean - own) * most;
                shift[1] = (mean - other) * most;
            }
            if (o->strength)
                strength = middle * (PERI_V(loadu)(half[0].strength + n * PERI_WIDTH) + PERI_V(loadu)(half[1].strength + n * PERI_WIDTH));
            if (bonds) strength = strength * PERI_V(loadu)(by_bond + n * PERI_WIDTH);
            if (o->stiffness) {
                const PERI_VECTOR own = PERI_V(loadu)(half[0].stiffness + n * PERI_WIDTH);
                const PERI_VECTOR other = PERI_V(loadu)(half[1].stiffness + n * PERI_WIDTH), product = own * other;
                between = (product + product) / (own + other);
            }
            const PERI_VECTOR pull = PERI_ISA_FN(half_pull)(&half[0], n, between, along, shift[0], reach)
                                   + PERI_ISA_FN(half_pull)(&half[1], n, between, along, shift[1], reach);
            const PERI_VECTOR scale = weight * pull / (reach * (now + tiny));
            hit |= (uint32_t)PERI_ABOVE(along, limit * strength * most, live) << (n * PERI_WIDTH);
            for (int a = 0; a < PERI_D; ++a) {
                PERI_VECTOR given = scale * y[a];
                if (tensors) {
                    const int64_t there = bond.offset + n * PERI_WIDTH;
                    PERI_VECTOR t = (PERI_V(loadu)(k + n * PERI_WIDTH) + PERI_V(loadu)(k + there)) * eta[a];
                    for (int d = 0; d < PERI_D; ++d) {
                        const peri_b *plane = tensor + (a * PERI_D + d) * m->stride;
                        t += (PERI_V(loadu)(plane + n * PERI_WIDTH) + PERI_V(loadu)(plane + there)) * bond.xi[d];
                    }
                    given += weight * t;
                }
                const PERI_VECTOR part = PERI_KEEP(live, given);
                if (o->working) PERI_V(storeu)(&force[a][n * PERI_WIDTH], part);
                PERI_ISA_FN(gather)(&sum[a][n], part);
            }
        }
        hit |= o->working ? PERI_ISA_FN(work)(o, g, &s, &bond, column, force) : 0;
    }
    PERI_ISA_FN(leave)(sum, f);
    return hit;
}

#undef PERI_PIECES
#undef PERI_WHOLE
