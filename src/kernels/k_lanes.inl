/* k_lanes.inl - the laws on columns (lanes.c): the equations of k_bond.inl and k_state.inl for PERI_LANES points at once, in pieces of
   PERI_WIDTH by the operations of k_vector.inl, operation by operation in the same order as by rows, so with the same result. Included per
   precision, dimension and instruction set; PERI_LANES_FN names it. `linear`, ... are constants where these are inlined.

   Points with a bond near its critical stretch are left to the rows. A dead lane may read anything, so its part is left out by a choice;
   columns where all lanes live, which most do, skip that. */

#define PERI_PIECES (PERI_LANES / PERI_WIDTH)
#define PERI_WHOLE 0xFFFF

typedef struct PERI_LANES_FN(group) { /* the columns of a group, the points of the group, and what they have now           */
    const peri__column *column, *end;
    const uint16_t     *alive; /* masks of the columns from the next on, or NULL                                         */
    const double       *table;
    const peri_r       *u;     /* [dim][stride] from the first point on                                                  */
    int64_t             stride;
    int                 breaking;
    PERI_STATE          own[PERI_D][PERI_PIECES];
} PERI_LANES_FN(group);

typedef struct PERI_LANES_FN(bond) { /* a column: what its bonds have in common                                            */
    PERI_VECTOR   xi[PERI_D], twice[PERI_D]; /* xi, 2 xi                                                                 */
    peri_b        length, inverse, weight;   /* |xi|, 1/|xi|, w beta V                                                   */
    peri_b        limit;                     /* critical stretch, with a margin                                          */
    const double *row;                       /* of the table                                                             */
    int64_t       offset;
    uint32_t      mask;
} PERI_LANES_FN(bond);

PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(enter)(PERI_LANES_FN(group) *s, const peri_body *b, int64_t g, int breaking) {
    const peri__model *m = b->model;
    const peri__lanes *lanes = &m->lanes;
    s->column = &lanes->column[lanes->first[g]];
    s->end = s->column + (lanes->begin[g + 1] - lanes->begin[g]);
    s->alive = b->lanes_alive ? &b->lanes_alive[lanes->begin[g]] : NULL;
    s->u = (const peri_r *)b->u + g * PERI_LANES;
    s->table = lanes->table;
    s->stride = m->stride;
    s->breaking = breaking;
    for (int d = 0; d < PERI_D; ++d)
        for (int n = 0; n < PERI_PIECES; ++n) s->own[d][n] = PERI_LANES_FN(take)(s->u + d * s->stride + n * PERI_WIDTH);
}

/* The next column with a live bond, or 0. */
PERI_LANES_TARGET PERI_INLINE int PERI_LANES_FN(next)(PERI_LANES_FN(group) *s, PERI_LANES_FN(bond) *bond) {
    PERI_NO_CONTRACTION
    do {
        if (s->column == s->end) return 0;
        bond->mask = s->alive ? *s->alive++ : s->column->member;
        bond->offset = s->column->offset;
        bond->row = &s->table[s->column->vector * PERI_TABLE_ROW];
        s->column++;
    } while (bond->mask == 0);
    for (int d = 0; d < PERI_D; ++d) {
        bond->xi[d] = PERI_V(set1)((peri_b)bond->row[d]);
        bond->twice[d] = bond->xi[d] + bond->xi[d];
    }
    bond->length = (peri_b)bond->row[3];
    bond->weight = (peri_b)bond->row[4];
    bond->inverse = (peri_b)bond->row[6];
    bond->limit = (peri_b)(s->breaking ? bond->row[8] * (1.0 - PERI_NEAR) : PERI_NEVER);
    return 1;
}

/* eta of piece n. */
PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(moved)(const PERI_LANES_FN(group) *s, const PERI_LANES_FN(bond) *bond, int n,
                                                        PERI_VECTOR eta[PERI_D]) {
    for (int d = 0; d < PERI_D; ++d)
        eta[d] = PERI_LANES_FN(apart)(s->u + d * s->stride + bond->offset + n * PERI_WIDTH, s->own[d][n]);
}

/* y = xi + eta, or xi; along = (2 xi + eta).eta, or xi.eta. Returns |y|, or |xi|. */
PERI_LANES_TARGET PERI_INLINE PERI_VECTOR PERI_LANES_FN(extend)(const PERI_LANES_FN(bond) *bond, const PERI_VECTOR eta[PERI_D],
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

PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(leave)(PERI_STATE sum[PERI_D][PERI_PIECES], peri_r f[PERI_D][PERI_LANES]) {
    for (int d = 0; d < PERI_D; ++d)
        for (int n = 0; n < PERI_PIECES; ++n) PERI_LANES_FN(spread)(&f[d][n * PERI_WIDTH], &sum[d][n]);
}

/* One column of bond-based bonds; c: the micromodulus times w beta V, where linear over |xi|^3. Returns a bit for each point with
   a live bond beyond its limit. */
PERI_LANES_TARGET PERI_INLINE uint32_t PERI_LANES_FN(column)(const PERI_LANES_FN(group) *s, const PERI_LANES_FN(bond) *bond, const peri_b c,
                                                             PERI_STATE sum[PERI_D][PERI_PIECES], const int whole, const int linear,
                                                             const int breaking) {
    PERI_NO_CONTRACTION
    const PERI_VECTOR length = PERI_V(set1)(bond->length), weight = PERI_V(set1)(c), tiny = PERI_V(set1)((peri_b)PERI_TINY);
    const PERI_VECTOR most = PERI_V(set1)(bond->limit * bond->length);
    uint32_t hit = 0;
    for (int n = 0; n < PERI_PIECES; ++n) {
        const PERI_LIVE live = PERI_TO_LIVE(bond->mask >> (n * PERI_WIDTH));
        PERI_VECTOR eta[PERI_D], y[PERI_D], along;
        PERI_LANES_FN(moved)(s, bond, n, eta);
        const PERI_VECTOR now = PERI_LANES_FN(extend)(bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
        const PERI_VECTOR scale = PERI_IF(linear, weight * along, weight * along / (reach * length * (now + tiny)));
        if (breaking) hit |= (uint32_t)PERI_ABOVE(along, most * reach, live) << (n * PERI_WIDTH);
        for (int d = 0; d < PERI_D; ++d) {
            PERI_LANES_FN(gather)(&sum[d][n], PERI_IF(whole, scale * y[d], PERI_KEEP_PRODUCT(live, scale, y[d])));
        }
    }
    return hit;
}

/* Adds the force of all live bonds of group g to f[PERI_D][PERI_LANES]. Returns a bit for each point with a live bond so near its critical
   stretch that the row must decide. */
PERI_LANES_TARGET PERI_INLINE uint32_t PERI_LANES_FN(lanes_of)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES],
                                                               const int linear, const int breaking) {
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_LANES_FN(group) s;
    PERI_LANES_FN(bond) bond;
    uint32_t hit = 0;
    PERI_LANES_FN(enter)(&s, step->body, g, step->breaking);
    for (int d = 0; d < PERI_D; ++d)
        for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_LANES_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_LANES_FN(next)(&s, &bond)) {
        peri_b c = (peri_b)bond.row[7] * bond.weight;
        if (linear) c *= bond.inverse * bond.inverse * bond.inverse;
        if (!PERI_FREE_CHOICE && bond.mask == PERI_WHOLE) hit |= PERI_LANES_FN(column)(&s, &bond, c, sum, 1, linear, breaking);
        else hit |= PERI_LANES_FN(column)(&s, &bond, c, sum, 0, linear, breaking);
    }
    PERI_LANES_FN(leave)(sum, f);
    return hit;
}

PERI_LANES_TARGET static uint32_t PERI_LANES_FN(lanes)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES]) {
    if (step->body->desc.geometry != PERI_LINEAR) return PERI_LANES_FN(lanes_of)(step, g, f, 0, 1);
    return step->breaking ? PERI_LANES_FN(lanes_of)(step, g, f, 1, 1) : PERI_LANES_FN(lanes_of)(step, g, f, 1, 0);
}

PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(stretched_column)(const PERI_LANES_FN(group) *s, const PERI_LANES_FN(bond) *bond,
                                                                   peri_b gauged, PERI_STATE sum[PERI_PIECES], const int whole,
                                                                   const int linear) {
    PERI_NO_CONTRACTION
    const PERI_VECTOR length = PERI_V(set1)(bond->length), weight = PERI_V(set1)(gauged);
    for (int n = 0; n < PERI_PIECES; ++n) {
        PERI_VECTOR eta[PERI_D], y[PERI_D], along;
        PERI_LANES_FN(moved)(s, bond, n, eta);
        const PERI_VECTOR now = PERI_LANES_FN(extend)(bond, eta, y, &along, linear);
        const PERI_VECTOR far = PERI_IF(linear, along, along / (now + length));
        const PERI_LIVE live = PERI_TO_LIVE(bond->mask >> (n * PERI_WIDTH));
        PERI_LANES_FN(gather)(&sum[n], PERI_IF(whole, weight * far, PERI_KEEP_PRODUCT(live, weight, far)));
    }
}

/* sum w g e V of the points of group g to out; g = gauged ? |xi| : 1. */
PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(stretched_of)(const peri_body *b, int64_t g, const int gauged, peri_r out[PERI_LANES],
                                                               const int linear) {
    const peri_r none[PERI_LANES] = { 0 };
    PERI_STATE sum[PERI_PIECES];
    PERI_LANES_FN(group) s;
    PERI_LANES_FN(bond) bond;
    PERI_LANES_FN(enter)(&s, b, g, 0);
    for (int n = 0; n < PERI_PIECES; ++n) sum[n] = PERI_LANES_FN(take)(none + n * PERI_WIDTH);
    while (PERI_LANES_FN(next)(&s, &bond)) {
        const peri_b weight = bond.weight * (linear ? (gauged ? 1 : bond.inverse) : gauged ? bond.length : 1);
        if (!PERI_FREE_CHOICE && bond.mask == PERI_WHOLE) PERI_LANES_FN(stretched_column)(&s, &bond, weight, sum, 1, linear);
        else PERI_LANES_FN(stretched_column)(&s, &bond, weight, sum, 0, linear);
    }
    for (int n = 0; n < PERI_PIECES; ++n) PERI_LANES_FN(spread)(out + n * PERI_WIDTH, &sum[n]);
}

PERI_LANES_TARGET static void PERI_LANES_FN(stretched)(const peri_body *b, int64_t g, const int gauged, peri_r sum[PERI_LANES]) {
    if (b->desc.geometry == PERI_LINEAR) PERI_LANES_FN(stretched_of)(b, g, gauged, sum, 1);
    else PERI_LANES_FN(stretched_of)(b, g, gauged, sum, 0);
}

/* sum w e^2 V of the points of group g to out, in bond-based bodies times c/|xi|: in double whatever the precision. */
PERI_LANES_TARGET static void PERI_LANES_FN(squares)(const peri_body *b, int64_t g, double out[PERI_LANES]) {
    PERI_NO_CONTRACTION
    const int linear = b->desc.geometry == PERI_LINEAR, states = b->model->states;
    PERI_LANES_FN(group) s;
    PERI_LANES_FN(bond) bond;
    PERI_LANES_FN(enter)(&s, b, g, 0);
    for (int l = 0; l < PERI_LANES; ++l) out[l] = 0.0;
    while (PERI_LANES_FN(next)(&s, &bond)) {
        const double weight = states ? (double)bond.weight : bond.row[7] * (double)bond.weight / (double)bond.length;
        const PERI_VECTOR length = PERI_V(set1)(bond.length);
        peri_b e[PERI_LANES];
        for (int n = 0; n < PERI_PIECES; ++n) {
            PERI_VECTOR eta[PERI_D], y[PERI_D], along;
            PERI_LANES_FN(moved)(&s, &bond, n, eta);
            const PERI_VECTOR now = PERI_LANES_FN(extend)(&bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
            PERI_V(storeu)(e + n * PERI_WIDTH, PERI_KEEP(PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH)), along / reach));
        }
        for (int l = 0; l < PERI_LANES; ++l) out[l] += weight * ((double)e[l] * (double)e[l]);
    }
}

/* One column of ordinary state-based bonds; p, q: of the points of the group; weighed = w beta V, where linear over |xi|^2; gauged = |xi|,
   or 1. */
PERI_LANES_TARGET PERI_INLINE uint32_t PERI_LANES_FN(share_column)(const PERI_LANES_FN(group) *s, const PERI_LANES_FN(bond) *bond,
                                                                   const peri_b *p, const peri_b *q, peri_b weighed, peri_b gauged,
                                                                   PERI_STATE sum[PERI_D][PERI_PIECES], const int whole, const int linear,
                                                                   const int breaking) {
    PERI_NO_CONTRACTION
    const PERI_VECTOR length = PERI_V(set1)(bond->length), weight = PERI_V(set1)(weighed), gauge = PERI_V(set1)(gauged);
    const PERI_VECTOR most = PERI_V(set1)(bond->limit * bond->length), tiny = PERI_V(set1)((peri_b)PERI_TINY);
    uint32_t hit = 0;
    for (int n = 0; n < PERI_PIECES; ++n) {
        const PERI_LIVE live = PERI_TO_LIVE(bond->mask >> (n * PERI_WIDTH));
        const PERI_VECTOR both_p = PERI_V(loadu)(p + n * PERI_WIDTH) + PERI_V(loadu)(p + bond->offset + n * PERI_WIDTH);
        const PERI_VECTOR both_q = PERI_V(loadu)(q + n * PERI_WIDTH) + PERI_V(loadu)(q + bond->offset + n * PERI_WIDTH);
        PERI_VECTOR eta[PERI_D], y[PERI_D], along;
        PERI_LANES_FN(moved)(s, bond, n, eta);
        const PERI_VECTOR now = PERI_LANES_FN(extend)(bond, eta, y, &along, linear), reach = PERI_IF(linear, length, now + length);
        const PERI_VECTOR pull = weight * (both_q * along + both_p * gauge * reach);
        const PERI_VECTOR scale = PERI_IF(linear, pull, pull / (reach * (now + tiny)));
        if (breaking) hit |= (uint32_t)PERI_ABOVE(along, most * reach, live) << (n * PERI_WIDTH);
        for (int d = 0; d < PERI_D; ++d) {
            PERI_LANES_FN(gather)(&sum[d][n], PERI_IF(whole, scale * y[d], PERI_KEEP_PRODUCT(live, scale, y[d])));
        }
    }
    return hit;
}

/* Adds the force of all live ordinary state-based bonds of group g to f. Returns as `lanes`. */
PERI_LANES_TARGET PERI_INLINE uint32_t PERI_LANES_FN(share_of)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES],
                                                               const int linear, const int breaking) {
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri_b *p = (const peri_b *)b->response + m->margin + g * PERI_LANES;
    const peri_b *q = (const peri_b *)b->constant + m->margin + PERI__SPRING * m->stride + g * PERI_LANES;
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_LANES_FN(group) s;
    PERI_LANES_FN(bond) bond;
    uint32_t hit = 0;
    PERI_LANES_FN(enter)(&s, b, g, step->breaking);
    for (int d = 0; d < PERI_D; ++d)
        for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_LANES_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_LANES_FN(next)(&s, &bond)) {
        const peri_b gauge = m->ordinary == PERI_OTERKUS ? 1 : bond.length;
        const peri_b weight = linear ? bond.weight * (bond.inverse * bond.inverse) : bond.weight;
        if (!PERI_FREE_CHOICE && bond.mask == PERI_WHOLE)
            hit |= PERI_LANES_FN(share_column)(&s, &bond, p, q, weight, gauge, sum, 1, linear, breaking);
        else hit |= PERI_LANES_FN(share_column)(&s, &bond, p, q, weight, gauge, sum, 0, linear, breaking);
    }
    PERI_LANES_FN(leave)(sum, f);
    return hit;
}

PERI_LANES_TARGET static uint32_t PERI_LANES_FN(share)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES]) {
    if (step->body->desc.geometry != PERI_LINEAR) return PERI_LANES_FN(share_of)(step, g, f, 0, 1);
    return step->breaking ? PERI_LANES_FN(share_of)(step, g, f, 1, 1) : PERI_LANES_FN(share_of)(step, g, f, 1, 0);
}

/* sum w eta xi V of correspondence points. */
PERI_LANES_TARGET static void PERI_LANES_FN(shape)(const peri_body *b, int64_t g, peri_r out[PERI_D][PERI_D][PERI_LANES]) {
    PERI_NO_CONTRACTION
    const peri_r none[PERI_LANES] = { 0 };
    PERI_STATE sum[PERI_D][PERI_D][PERI_PIECES];
    PERI_LANES_FN(group) s;
    PERI_LANES_FN(bond) bond;
    PERI_LANES_FN(enter)(&s, b, g, 0);
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d)
            for (int n = 0; n < PERI_PIECES; ++n) sum[a][d][n] = PERI_LANES_FN(take)(none + n * PERI_WIDTH);
    while (PERI_LANES_FN(next)(&s, &bond)) {
        const PERI_VECTOR weight = PERI_V(set1)(bond.weight);
        for (int n = 0; n < PERI_PIECES; ++n) {
            const PERI_LIVE live = PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH));
            PERI_VECTOR eta[PERI_D];
            PERI_LANES_FN(moved)(&s, &bond, n, eta);
            for (int a = 0; a < PERI_D; ++a) {
                const PERI_VECTOR pulled = PERI_KEEP_PRODUCT(live, weight, eta[a]);
                for (int d = 0; d < PERI_D; ++d) PERI_LANES_FN(gather)(&sum[a][d][n], pulled * bond.xi[d]);
            }
        }
    }
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d)
            for (int n = 0; n < PERI_PIECES; ++n) PERI_LANES_FN(spread)(&out[a][d][n * PERI_WIDTH], &sum[a][d][n]);
}

/* Adds the force of all live bonds of a group of correspondence points to f, w ((Q_i + Q_j) xi + (k_i + k_j) eta); no central bonds.
   Returns as `lanes`; critical are (2 xi + eta).eta > s0 (2 + s0) |xi|^2, or xi.eta > s0 |xi|^2. */
PERI_LANES_TARGET static uint32_t PERI_LANES_FN(tensor)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES]) {
    PERI_NO_CONTRACTION
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri_b *q = (const peri_b *)b->response + m->margin + m->stride + g * PERI_LANES;
    const peri_b *k = (const peri_b *)b->constant + m->margin + PERI__VECTOR * m->stride + g * PERI_LANES;
    const int linear = b->desc.geometry == PERI_LINEAR;
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_LANES_FN(group) s;
    PERI_LANES_FN(bond) bond;
    uint32_t hit = 0;
    PERI_LANES_FN(enter)(&s, b, g, step->breaking);
    for (int d = 0; d < PERI_D; ++d)
        for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_LANES_FN(take)(&f[d][n * PERI_WIDTH]);
    while (PERI_LANES_FN(next)(&s, &bond)) {
        const PERI_VECTOR weight = PERI_V(set1)(bond.weight);
        const peri_b most = linear ? bond.limit : bond.limit * (2 + bond.limit);
        const PERI_VECTOR limit = PERI_V(set1)(most * bond.length * bond.length); /* infinite where none breaks */
        for (int n = 0; n < PERI_PIECES; ++n) {
            const PERI_LIVE live = PERI_TO_LIVE(bond.mask >> (n * PERI_WIDTH));
            const peri_b *const here = q + n * PERI_WIDTH, *const there = here + bond.offset;
            const PERI_VECTOR both = PERI_V(loadu)(k + n * PERI_WIDTH) + PERI_V(loadu)(k + bond.offset + n * PERI_WIDTH);
            PERI_VECTOR eta[PERI_D], y[PERI_D], along = PERI_V(set1)(0);
            PERI_LANES_FN(moved)(&s, &bond, n, eta);
            for (int a = 0; a < PERI_D; ++a) {
                y[a] = both * eta[a];
                for (int d = 0; d < PERI_D; ++d) {
                    const int64_t plane = (a * PERI_D + d) * m->stride;
                    y[a] += (PERI_V(loadu)(here + plane) + PERI_V(loadu)(there + plane)) * bond.xi[d];
                }
                along += PERI_IF(linear, bond.xi[a], bond.twice[a] + eta[a]) * eta[a];
            }
            hit |= (uint32_t)PERI_ABOVE(along, limit, live) << (n * PERI_WIDTH);
            for (int a = 0; a < PERI_D; ++a) PERI_LANES_FN(gather)(&sum[a][n], PERI_KEEP_PRODUCT(live, weight, y[a]));
        }
    }
    PERI_LANES_FN(leave)(sum, f);
    return hit;
}

#undef PERI_PIECES
#undef PERI_WHOLE
