/* SPDX-License-Identifier: MIT */
/* list.inl - the passes over the list: the equations of rows.inl for PERI_CHUNK bonds of a row at once, in pieces of PERI_WIDTH lanes by
   the operations of vector.inl. Bond k of a row is added in lane k % PERI_CHUNK, and lanes are added up in halves: the same bits from every
   instruction set and any number of threads. Bonds that come near their critical stretch are left to the rows. Included per precision,
   dimension and instruction set.

   What is needed of a neighbour lies side by side in its record, ->records, m->record_reals of them: x, u, then p and q, or Q and k, or
   the material. */

#define PERI_PIECES (PERI_CHUNK / PERI_WIDTH)

typedef struct PERI_ISA_FN(piece) { /* PERI_WIDTH bonds                                                                 */
    PERI_VECTOR got[8];               /* the records of the neighbours, less x and u of the point                        */
    PERI_VECTOR y[PERI_D], along;     /* as in columns.inl                                                               */
    PERI_VECTOR rest, now;            /* |xi|^2, |y|^2                                                                   */
} PERI_ISA_FN(piece);

PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(span)(PERI_ISA_FN(piece) *s, const peri_r *records, int32_t reals, const int32_t *ids,
                                                       const peri_r *own, const int linear) {
    PERI_NO_CONTRACTION
    PERI_ISA_FN(differ)(records, reals, ids, own, s->got);
    if (reals > 4) PERI_ISA_FN(differ)(records + 4, reals, ids, own + 4, s->got + 4);
    for (int d = 0; d < PERI_D; ++d) {
        const PERI_VECTOR xi = s->got[d], eta = s->got[PERI_D + d];
        const PERI_VECTOR along = PERI_IF(linear, xi, xi + xi + eta) * eta, rest = xi * xi;
        s->y[d] = PERI_IF(linear, xi, xi + eta);
        s->along = PERI_IF(d == 0, along, s->along + along);
        s->rest = PERI_IF(d == 0, rest, s->rest + rest);
        if (linear) continue;
        const PERI_VECTOR now = s->y[d] * s->y[d];
        s->now = PERI_IF(d == 0, now, s->now + now);
    }
    if (linear) s->now = s->rest;
}

/* product: |xi| |y|; returns R = |xi| (|y| + |xi|). Then |xi| e = |xi|^2 along/R, and laws whose gauge is |xi| (`by_length`) need no square
   root but that of |xi|^2 |y|^2: `bond` is |xi|^2 with these, and |xi| else. */
PERI_ISA_TARGET PERI_INLINE PERI_VECTOR PERI_ISA_FN(roots)(const PERI_ISA_FN(piece) *s, PERI_VECTOR *bond, PERI_VECTOR *product,
                                                               const int by_length, const int linear) {
    PERI_NO_CONTRACTION
    *bond = PERI_IF(by_length, s->rest, PERI_V(sqrt)(s->rest));
    if (linear) *product = s->rest;
    else if (by_length) *product = PERI_V(sqrt)(s->rest * s->now);
    else *product = *bond * PERI_V(sqrt)(s->now);
    return PERI_IF(linear, s->rest, *product + s->rest);
}

/* Flags of the PERI_CHUNK bonds of row i from bond k on. */
PERI_INLINE uint32_t PERI_ISA_FN(live)(const peri__operands *o, int64_t i, int64_t k, int64_t count) {
    const uint32_t flags = o->alive ? o->alive[i * o->model->words + k / 32] >> (k % 32) : ~(uint32_t)0;
    return flags & (((uint32_t)1 << (count - k < PERI_CHUNK ? count - k : PERI_CHUNK)) - 1);
}

/* The least critical stretch of bonds of point i, less a margin; it is no call where there is one class. */
PERI_INLINE double PERI_ISA_FN(near_stretch)(const peri__operands *o, int64_t i) {
    if (!o->breaking) return PERI_NEVER;
    return (o->point_class ? peri__least_stretch(o, i) : o->pairs->s0) * (1.0 - PERI_NEAR);
}

/* The sum over all lanes. */
PERI_ISA_TARGET PERI_INLINE peri_r PERI_ISA_FN(added)(PERI_STATE *sum) {
    for (int half = PERI_PIECES / 2; half > 0; half /= 2)
        for (int n = 0; n < half; ++n) PERI_ISA_FN(merge)(&sum[n], &sum[n + half]);
    return PERI_ISA_FN(fold)(sum);
}

/* Adds the force of all live bonds of the point at a place to f, all points being of laws alike: pairwise, or ordinary. Returns nonzero
   where a bond comes near its critical stretch; f is then void. `pairwise`, `by_length` and `reals` are constants where this is inlined. */
PERI_ISA_TARGET PERI_INLINE int PERI_ISA_FN(list_row)(const peri__operands *o, int64_t place, peri_r *f, const int pairwise,
                                                          const int by_length, const int32_t reals, const int linear) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const int several = PERI_D == 2 ? reals > 4 : m->materials > 1;
    const peri_r *records = (const peri_r *)o->records, *mine = records + place * reals;
    const peri_b *weights = (const peri_b *)m->weight + first, *backs = (const peri_b *)m->back + first;
    const PERI_VECTOR limit = PERI_V(set1)((peri_b)PERI_ISA_FN(near_stretch)(o, i));
    const PERI_VECTOR tiny = PERI_V(set1)((peri_b)PERI_TINY);
    const PERI_VECTOR pi = PERI_V(set1)(!pairwise ? (peri_b)mine[2 * PERI_D] : 0);
    const PERI_VECTOR qi = PERI_V(set1)(!pairwise ? (peri_b)mine[2 * PERI_D + 1] : 0);
    const int32_t *ids = &m->ids[first];
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_VECTOR c = PERI_V(set1)((peri_b)m->pairs->c);
    peri_b table[PERI_MATERIAL_LIMIT], pick[PERI_WIDTH];
    peri_r own[8] = { 0 };
    const peri_r none[PERI_WIDTH] = { 0 };
    int hit = 0;
    for (int32_t k = 0; pairwise && several && k < m->materials; ++k)
        table[k] = (peri_b)m->pairs[m->material[i] * m->materials + k].c;
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n)
        for (int d = 0; d < PERI_D; ++d) sum[d][n] = PERI_ISA_FN(take)(none);
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = mine[d];
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const int64_t at = k + n * PERI_WIDTH;
            const PERI_LIVE live = PERI_TO_LIVE(flags >> (n * PERI_WIDTH));
            const PERI_VECTOR weight = PERI_V(loadu)(weights + at);
            PERI_ISA_FN(piece) s;
            PERI_ISA_FN(span)(&s, records, reals, ids + at, own, linear);
            PERI_VECTOR scale, bond, product, reach;
            reach = PERI_ISA_FN(roots)(&s, &bond, &product, by_length, linear);
            if (!pairwise) { /* w (p g + q e)/|y| */
                const PERI_VECTOR back = PERI_V(loadu)(backs + at);
                const PERI_VECTOR p = weight * pi + back * s.got[2 * PERI_D], q = weight * qi + back * s.got[2 * PERI_D + 1];
                scale = q * s.along;
                if (!by_length) scale = scale * bond;
                scale = bond * (scale + p * reach);
            } else { /* c w e/(|xi| |y|) */
                if (several) {
                    PERI_V(storeu)(pick, s.got[2 * PERI_D]);
                    for (int l = 0; l < PERI_WIDTH; ++l) pick[l] = table[(int)pick[l]];
                    c = PERI_V(loadu)(pick);
                }
                scale = c * weight * s.along * bond;
            }
            scale = scale / (reach * (product + tiny));
            hit |= (int)PERI_ABOVE(s.along, limit * reach, live);
            for (int d = 0; d < PERI_D; ++d) /* a choice: what a dead lane read may be anything */
                PERI_ISA_FN(gather)(&sum[d][n], PERI_KEEP_PRODUCT(live, scale, s.y[d]));
        }
    }
    for (int d = 0; d < PERI_D; ++d) f[d] += PERI_ISA_FN(added)(sum[d]);
    return hit;
}

/* Geometry is a constant where that makes a difference in time. */
#define PERI_BY_GEOMETRY(call, ...) (PERI_COMPACT ? call(__VA_ARGS__, o->linear) : o->linear ? call(__VA_ARGS__, 1) : call(__VA_ARGS__, 0))

PERI_ISA_TARGET static int PERI_ISA_FN(list_pairwise)(const peri__operands *o, int64_t place, peri_r *f) {
    if (PERI_D == 2 && o->model->record_reals == 4) return PERI_BY_GEOMETRY(PERI_ISA_FN(list_row), o, place, f, 1, 0, 4);
    return PERI_BY_GEOMETRY(PERI_ISA_FN(list_row), o, place, f, 1, 0, 8);
}

PERI_ISA_TARGET static int PERI_ISA_FN(list_ordinary)(const peri__operands *o, int64_t place, peri_r *f) {
    if (o->model->gauge) return PERI_BY_GEOMETRY(PERI_ISA_FN(list_row), o, place, f, 0, 1, 8);
    return PERI_ISA_FN(list_row)(o, place, f, 0, 0, 8, o->linear);
}

/* sum w g e V of the point at a place. */
PERI_ISA_TARGET PERI_INLINE peri_r PERI_ISA_FN(list_sum)(const peri__operands *o, int64_t place, const int by_length, const int linear) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const peri_r *records = (const peri_r *)o->records;
    const peri_b *weights = (const peri_b *)m->weight + first;
    const int32_t *ids = &m->ids[first];
    PERI_STATE sum[PERI_PIECES];
    peri_r own[8] = { 0 };
    const peri_r none[PERI_WIDTH] = { 0 };
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[n] = PERI_ISA_FN(take)(none);
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = records[place * 8 + d];
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            PERI_VECTOR part = PERI_V(loadu)(weights + k + n * PERI_WIDTH), bond, product, reach;
            PERI_ISA_FN(piece) s;
            PERI_ISA_FN(span)(&s, records, 8, ids + k + n * PERI_WIDTH, own, linear);
            part = part * s.along;
            if (!linear || !by_length) {
                reach = PERI_ISA_FN(roots)(&s, &bond, &product, by_length, linear);
                part = part * bond / reach;
            }
            PERI_ISA_FN(gather)(&sum[n], PERI_KEEP(PERI_TO_LIVE(flags >> (n * PERI_WIDTH)), part));
        }
    }
    return PERI_ISA_FN(added)(sum);
}

PERI_ISA_TARGET static peri_r PERI_ISA_FN(list_dilatation_sum)(const peri__operands *o, int64_t place) {
    const peri__model *m = o->model;
    if (m->mixed ? m->laws[m->material[peri__nth(m, place)]].gauge : m->gauge) return PERI_BY_GEOMETRY(PERI_ISA_FN(list_sum), o, place, 1);
    return PERI_ISA_FN(list_sum)(o, place, 0, o->linear);
}
#undef PERI_BY_GEOMETRY

/* Of the live bonds of the point at a place the least stretch, HUGE_VAL where there are none; or where `squares` sum w e^2 V. In double. */
PERI_ISA_TARGET static double PERI_ISA_FN(list_least)(const peri__operands *o, int64_t place, int squares) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const int32_t reals = m->record_reals;
    const int linear = o->linear;
    const peri_r *records = (const peri_r *)o->records;
    const peri_b *weights = (const peri_b *)m->weight + first;
    double lane[PERI_CHUNK];
    peri_r own[8] = { 0 };
    for (int l = 0; l < PERI_CHUNK; ++l) lane[l] = squares ? 0.0 : HUGE_VAL;
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = records[place * reals + d];
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        peri_b extended[PERI_CHUNK], reached[PERI_CHUNK], rest[PERI_CHUNK];
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const int at = n * PERI_WIDTH;
            PERI_ISA_FN(piece) s;
            for (int g = 4; g < 8; ++g) s.got[g] = PERI_V(set1)(0); /* small records have none */
            PERI_ISA_FN(span)(&s, records, reals, &m->ids[first + k + at], own, linear);
            const PERI_VECTOR length = PERI_V(sqrt)(s.rest);
            PERI_V(storeu)(extended + at, s.along);
            PERI_V(storeu)(reached + at, PERI_IF(linear, length, PERI_V(sqrt)(s.now) + length));
            PERI_V(storeu)(rest + at, length);
        }
        for (int l = 0; squares && l < PERI_CHUNK; ++l) {
            const double e = (double)extended[l] / (double)reached[l];
            lane[l] += flags >> l & 1 ? (double)weights[k + l] * (e * e) : 0.0;
        }
        for (int l = 0; !squares && l < PERI_CHUNK; ++l) {
            const double stretch = (double)extended[l] / ((double)reached[l] * (double)rest[l]);
            lane[l] = ((int)(flags >> l & 1) & (stretch < lane[l])) ? stretch : lane[l];
        }
    }
    PERI_NO_UNROLLING for (int half = PERI_CHUNK / 2; half > 0; half /= 2)
        PERI_NO_UNROLLING for (int l = 0; l < half; ++l) {
            const double other = lane[l + half];
            lane[l] = squares ? lane[l] + other : other < lane[l] ? other : lane[l];
        }
    return lane[0];
}

/* ---- fields of material ------------------------------------------------------------------------------------------- */

typedef struct PERI_ISA_FN(lanes) { /* fields of PERI_CHUNK bonds of a row                                               */
    peri_b mean[PERI_CHUNK], other[PERI_CHUNK]; /* eigenstrain of the bond and of its far end                             */
    peri_b strength[PERI_CHUNK], between[PERI_CHUNK], slack[PERI_CHUNK]; /* slack: a margin of `mean`                     */
} PERI_ISA_FN(lanes);

/* Of the bonds of point i from entry `at` of the list on. */
PERI_INLINE void PERI_ISA_FN(see_lanes)(const peri__operands *o, int64_t i, int64_t at, PERI_ISA_FN(lanes) *lanes) {
    const peri__model *m = o->model;
    const peri_b *eigenstrain = (const peri_b *)o->eigenstrain, *strength = (const peri_b *)o->strength;
    const peri_b *stiffness = (const peri_b *)o->stiffness;
    const peri_b zero = 0, one = 1, *const own = eigenstrain ? eigenstrain + i : &zero;
    for (int l = 0; l < PERI_CHUNK; ++l) {
        const int64_t place = m->ids[at + l], j = m->order ? m->order[place] : place;
        lanes->other[l] = eigenstrain ? eigenstrain[j] : zero;
        lanes->mean[l] = (peri_b)0.5 * (*own + lanes->other[l]);
        lanes->slack[l] = (peri_b)PERI_NEAR * (lanes->mean[l] < 0 ? -lanes->mean[l] : lanes->mean[l]);
        lanes->strength[l] = strength ? (peri_b)0.5 * (strength[i] + strength[j]) : one;
        if (o->bond_strength) lanes->strength[l] *= (peri_b)o->bond_strength[at + l];
        lanes->between[l] = stiffness ? 2 * (stiffness[i] * stiffness[j]) / (stiffness[i] + stiffness[j]) : one;
    }
}

/* As list_row, by the fields of material: q e + p g of both ends, as rows have it. */
PERI_ISA_TARGET static int PERI_ISA_FN(list_fielded)(const peri__operands *o, int64_t place, peri_r *f) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const int32_t reals = m->record_reals;
    const int linear = o->linear, pairwise = m->pairwise, several = pairwise && (PERI_D == 2 ? reals > 4 : m->materials > 1);
    const peri_r *records = (const peri_r *)o->records, *mine = records + place * reals, none[PERI_WIDTH] = { 0 };
    const peri_b *weights = (const peri_b *)m->weight + first, *backs = (const peri_b *)m->back + first;
    const PERI_VECTOR limit = PERI_V(set1)((peri_b)PERI_ISA_FN(near_stretch)(o, i)), tiny = PERI_V(set1)((peri_b)PERI_TINY);
    const PERI_VECTOR pi = PERI_V(set1)(!pairwise ? (peri_b)mine[2 * PERI_D] : 0);
    const PERI_VECTOR qi = PERI_V(set1)(!pairwise ? (peri_b)mine[2 * PERI_D + 1] : 0);
    const PERI_VECTOR eigen = PERI_V(set1)(o->eigenstrain ? ((const peri_b *)o->eigenstrain)[i] : 0);
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_VECTOR half = PERI_V(set1)((peri_b)(0.5 * m->pairs->c));
    PERI_ISA_FN(lanes) lanes;
    peri_b table[PERI_MATERIAL_LIMIT], pick[PERI_WIDTH];
    peri_r own[8] = { 0 };
    int hit = 0;
    for (int32_t k = 0; several && k < m->materials; ++k) table[k] = (peri_b)(0.5 * m->pairs[m->material[i] * m->materials + k].c);
    for (int d = 0; d < PERI_D; ++d)
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(none);
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = mine[d];
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        PERI_ISA_FN(see_lanes)(o, i, first + k, &lanes);
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) {
            const int at = n * PERI_WIDTH;
            const PERI_LIVE live = PERI_TO_LIVE(flags >> at);
            const PERI_VECTOR weight = PERI_V(loadu)(weights + k + at), back = PERI_V(loadu)(backs + k + at);
            const PERI_VECTOR mean = PERI_V(loadu)(lanes.mean + at), other = PERI_V(loadu)(lanes.other + at);
            PERI_ISA_FN(piece) s;
            for (int g = 4; g < 8; ++g) s.got[g] = PERI_V(set1)(0); /* small records have none */
            PERI_ISA_FN(span)(&s, records, reals, &m->ids[first + k + at], own, linear);
            const PERI_VECTOR length = PERI_V(sqrt)(s.rest), now = PERI_IF(linear, length, PERI_V(sqrt)(s.now));
            const PERI_VECTOR reach = PERI_IF(linear, length, now + length), most = length * reach, along = s.along - mean * most;
            PERI_VECTOR here, there;
            if (pairwise) {
                if (several) {
                    PERI_V(storeu)(pick, s.got[2 * PERI_D]);
                    for (int l = 0; l < PERI_WIDTH; ++l) pick[l] = table[(int)pick[l]];
                    half = PERI_V(loadu)(pick);
                }
                here = there = half / length * PERI_V(loadu)(lanes.between + at) * along;
            } else {
                const PERI_VECTOR gauge = PERI_IF(m->gauge, length, PERI_V(set1)(1));
                here = qi * (along + (mean - eigen) * most) + pi * gauge * reach;
                there = s.got[2 * PERI_D + 1] * (along + (mean - other) * most) + s.got[2 * PERI_D] * gauge * reach;
            }
            const PERI_VECTOR scale = (weight * here + back * there) / (reach * (now + tiny));
            const PERI_VECTOR least = (limit * PERI_V(loadu)(lanes.strength + at) - PERI_V(loadu)(lanes.slack + at)) * most;
            hit |= (int)PERI_ABOVE(along, least, live);
            for (int d = 0; d < PERI_D; ++d) PERI_ISA_FN(gather)(&sum[d][n], PERI_KEEP_PRODUCT(live, scale, s.y[d]));
        }
    }
    for (int d = 0; d < PERI_D; ++d) f[d] += PERI_ISA_FN(added)(sum[d]);
    return hit;
}

/* ---- laws that differ, the work on bonds --------------------------------------------------------------------------- */

/* As list_row, whatever the laws of the ends, none of them with a gradient: q e + p g of both ends, q of a pairwise law c/(2 |xi|). Counts
   the work on bonds where that is asked for, and returns nonzero where it comes near its limit, too. */
PERI_ISA_TARGET static int PERI_ISA_FN(list_mixed)(const peri__operands *o, int64_t place, peri_r *f) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const int32_t material = m->material[i];
    const int linear = o->linear, by_length = m->laws[material].gauge;
    const peri_r *records = (const peri_r *)o->records, *mine = records + place * 8, none[PERI_WIDTH] = { 0 };
    const peri_b *weights = (const peri_b *)m->weight + first, *backs = (const peri_b *)m->back + first;
    const PERI_VECTOR limit = PERI_V(set1)((peri_b)PERI_ISA_FN(near_stretch)(o, i)), tiny = PERI_V(set1)((peri_b)PERI_TINY);
    const PERI_VECTOR pi = PERI_V(set1)((peri_b)mine[2 * PERI_D]), qi = PERI_V(set1)((peri_b)mine[2 * PERI_D + 1]);
    const PERI_VECTOR one = PERI_V(set1)(1);
    PERI_STATE sum[PERI_D][PERI_PIECES];
    peri_r own[8] = { 0 };
    peri_b table[3][PERI_MATERIAL_LIMIT], lane[3][PERI_CHUNK];
    peri_b force[PERI_D][PERI_CHUNK], eta[PERI_D][PERI_CHUNK];
    int hit = 0;
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = mine[d];
    PERI_FN(tell_ends)(m, material, table);
    for (int n = 0; n < 3; ++n)
        PERI_NO_UNROLLING for (int l = 0; l < PERI_CHUNK; ++l) lane[n][l] = table[n][0];
    for (int d = 0; d < PERI_D; ++d)
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(none);
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        for (int l = 0; m->materials > 1 && l < PERI_CHUNK; ++l) {
            const int32_t other = m->material[peri__nth(m, m->ids[first + k + l])];
            for (int n = 0; n < 3; ++n) lane[n][l] = table[n][other];
        }
        PERI_NO_UNROLLING for (int n = 0; n < PERI_PIECES; ++n) {
            const int at = n * PERI_WIDTH;
            const PERI_LIVE live = PERI_TO_LIVE(flags >> at);
            const PERI_VECTOR weight = PERI_V(loadu)(weights + k + at), back = PERI_V(loadu)(backs + k + at);
            const PERI_VECTOR far_gauge = PERI_V(loadu)(lane[2] + at);
            PERI_ISA_FN(piece) s;
            PERI_ISA_FN(span)(&s, records, 8, &m->ids[first + k + at], own, linear);
            const PERI_VECTOR length = PERI_V(sqrt)(s.rest), now = PERI_IF(linear, length, PERI_V(sqrt)(s.now));
            const PERI_VECTOR reach = PERI_IF(linear, length, now + length);
            const PERI_VECTOR q = weight * (qi + PERI_V(loadu)(lane[0] + at) / length)
                                + back * (s.got[2 * PERI_D + 1] + PERI_V(loadu)(lane[1] + at) / length);
            const PERI_VECTOR p = weight * (pi * PERI_IF(by_length, length, one))
                                + back * (s.got[2 * PERI_D] * (far_gauge * length + (one - far_gauge)));
            const PERI_VECTOR scale = (q * s.along + p * reach) / (reach * (now + tiny));
            hit |= (int)PERI_ABOVE(s.along, limit * length * reach, live);
            for (int d = 0; d < PERI_D; ++d) {
                const PERI_VECTOR part = PERI_KEEP_PRODUCT(live, scale, s.y[d]);
                PERI_ISA_FN(gather)(&sum[d][n], part);
                if (!o->working) continue;
                PERI_V(storeu)(force[d] + at, part);
                PERI_V(storeu)(eta[d] + at, s.got[PERI_D + d]);
            }
        }
        if (o->working) hit |= PERI_FN(count_chunk)(o, i, k, flags, force, eta);
    }
    for (int d = 0; d < PERI_D; ++d) f[d] += PERI_ISA_FN(added)(sum[d]);
    return hit;
}

/* ---- gradients ---------------------------------------------------------------------------------------------------- */

#define PERI_TENSOR_RECORD (PERI_D == 2 ? 12 : 16) /* of a record: x, u, Q, k                                            */

/* sum w eta xi V of the point at a place. */
PERI_ISA_TARGET static void PERI_ISA_FN(list_shape)(const peri__operands *o, int64_t place, peri_r shape[PERI_D][PERI_D]) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const peri_r *records = (const peri_r *)o->records, none[PERI_WIDTH] = { 0 };
    const peri_b *weights = (const peri_b *)m->weight + first;
    const int32_t reals = m->record_reals;
    peri_r own[8] = { 0 };
    PERI_STATE sum[PERI_D][PERI_D][PERI_PIECES];
    PERI_VECTOR got[8];
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = records[place * reals + d];
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d)
            PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[a][d][n] = PERI_ISA_FN(take)(none);
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const int32_t *ids = &m->ids[first + k + n * PERI_WIDTH];
            const PERI_LIVE live = PERI_TO_LIVE(flags >> (n * PERI_WIDTH));
            const PERI_VECTOR weight = PERI_V(loadu)(weights + k + n * PERI_WIDTH);
            PERI_ISA_FN(differ)(records, reals, ids, own, got);
            if (PERI_D == 3) PERI_ISA_FN(differ)(records + 4, reals, ids, own + 4, got + 4);
            for (int a = 0; a < PERI_D; ++a) {
                const PERI_VECTOR pulled = PERI_KEEP_PRODUCT(live, weight, got[PERI_D + a]);
                for (int d = 0; d < PERI_D; ++d) PERI_ISA_FN(gather)(&sum[a][d][n], PERI_KEEP_PRODUCT(live, pulled, got[d]));
            }
        }
    }
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) shape[a][d] = PERI_ISA_FN(added)(sum[a][d]);
}

/* sum w |eta - H xi|^2 V of the point at a place; the sum in double. */
PERI_ISA_TARGET static double PERI_ISA_FN(list_misfit)(const peri__operands *o, int64_t place, peri_r h[PERI_D][PERI_D]) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const peri_r *records = (const peri_r *)o->records;
    const peri_b *weights = (const peri_b *)m->weight + first;
    double lane[PERI_CHUNK] = { 0 };
    peri_r own[8] = { 0 };
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = records[place * PERI_TENSOR_RECORD + d];
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        peri_b apart[8][PERI_CHUNK]; /* xi, eta */
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const int32_t *ids = &m->ids[first + k + n * PERI_WIDTH];
            PERI_VECTOR got[8];
            PERI_ISA_FN(differ)(records, PERI_TENSOR_RECORD, ids, own, got);
            if (PERI_D == 3) PERI_ISA_FN(differ)(records + 4, PERI_TENSOR_RECORD, ids, own + 4, got + 4);
            for (int d = 0; d < 2 * PERI_D; ++d) PERI_V(storeu)(apart[d] + n * PERI_WIDTH, got[d]);
        }
        for (int a = 0; a < PERI_D; ++a)
            for (int l = 0; l < PERI_CHUNK; ++l) {
                peri_r z = apart[PERI_D + a][l];
                for (int d = 0; d < PERI_D; ++d) z -= h[a][d] * apart[d][l];
                lane[l] += flags >> l & 1 ? (double)weights[k + l] * ((double)z * (double)z) : 0.0;
            }
    }
    PERI_NO_UNROLLING for (int half = PERI_CHUNK / 2; half > 0; half /= 2)
        PERI_NO_UNROLLING for (int l = 0; l < half; ++l) lane[l] += lane[l + half];
    return lane[0];
}

/* Adds the force of all live bonds of the point i at a place to f, (w_ij Q_i + w_ji Q_j) xi + (w_ij k_i + w_ji k_j) eta; no central bonds.
   Returns nonzero where a bond comes near its critical stretch; f is then void. */
PERI_ISA_TARGET static int PERI_ISA_FN(list_tensor)(const peri__operands *o, int64_t place, peri_r *f) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const int linear = o->linear;
    const peri_r *records = (const peri_r *)o->records, *mine = records + place * PERI_TENSOR_RECORD, none[PERI_WIDTH] = { 0 };
    const peri_b *weights = (const peri_b *)m->weight + first, *backs = (const peri_b *)m->back + first;
    const peri_b s0 = (peri_b)PERI_ISA_FN(near_stretch)(o, i);
    const PERI_VECTOR same = PERI_V(set1)(linear ? s0 : s0 * (2 + s0)); /* infinite where none breaks */
    PERI_ISA_FN(lanes) lanes;
    peri_b limits[PERI_CHUNK], force[PERI_D][PERI_CHUNK], change[PERI_D][PERI_CHUNK];
    peri_r own[PERI_TENSOR_RECORD] = { 0 };
    PERI_STATE sum[PERI_D][PERI_PIECES];
    PERI_VECTOR got[PERI_TENSOR_RECORD];
    int hit = 0;
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = mine[d];
    for (int d = 0; d < PERI_D; ++d)
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) sum[d][n] = PERI_ISA_FN(take)(none);
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_ISA_FN(live)(o, i, k, count);
        if (o->fields) {
            PERI_ISA_FN(see_lanes)(o, i, first + k, &lanes);
            for (int l = 0; l < PERI_CHUNK; ++l) {
                const peri_b stretch = s0 * lanes.strength[l] + lanes.mean[l] - lanes.slack[l];
                limits[l] = linear ? stretch : stretch * (2 + stretch);
            }
        }
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const int32_t *ids = &m->ids[first + k + n * PERI_WIDTH];
            const PERI_LIVE live = PERI_TO_LIVE(flags >> (n * PERI_WIDTH));
            const PERI_VECTOR limit = o->fields ? PERI_V(loadu)(limits + n * PERI_WIDTH) : same;
            const PERI_VECTOR weight = PERI_V(loadu)(weights + k + n * PERI_WIDTH), back = PERI_V(loadu)(backs + k + n * PERI_WIDTH);
            PERI_VECTOR along = PERI_V(set1)(0), rest = along;
            for (int s = 0; s < PERI_TENSOR_RECORD; s += 4) PERI_ISA_FN(differ)(records + s, PERI_TENSOR_RECORD, ids, own + s, got + s);
            const PERI_VECTOR *xi = got, *eta = got + PERI_D, *q = got + 2 * PERI_D, vector = got[2 * PERI_D + PERI_D * PERI_D];
            for (int d = 0; d < PERI_D; ++d) {
                along += PERI_IF(linear, xi[d], xi[d] + xi[d] + eta[d]) * eta[d];
                rest += xi[d] * xi[d];
            }
            hit |= (int)PERI_ABOVE(along, limit * rest, live);
            for (int a = 0; a < PERI_D; ++a) {
                const peri_r *own_q = mine + 2 * PERI_D + a * PERI_D;
                PERI_VECTOR t = (weight * PERI_V(set1)((peri_b)mine[2 * PERI_D + PERI_D * PERI_D]) + back * vector) * eta[a];
                for (int d = 0; d < PERI_D; ++d) t += (weight * PERI_V(set1)((peri_b)own_q[d]) + back * q[a * PERI_D + d]) * xi[d];
                const PERI_VECTOR part = PERI_KEEP(live, t);
                PERI_ISA_FN(gather)(&sum[a][n], part);
                if (!o->working) continue;
                PERI_V(storeu)(force[a] + n * PERI_WIDTH, part);
                PERI_V(storeu)(change[a] + n * PERI_WIDTH, eta[a]);
            }
        }
        if (o->working) hit |= PERI_FN(count_chunk)(o, i, k, flags, force, change);
    }
    for (int d = 0; d < PERI_D; ++d) f[d] += PERI_ISA_FN(added)(sum[d]);
    return hit;
}
#undef PERI_TENSOR_RECORD

/* The bonds `first`, ... of the point at a place for its laws of bonds: of the live ones the stretch, of the others 0; what a force of 1
   pulls with. */
PERI_ISA_TARGET PERI_INLINE void PERI_ISA_FN(stretch_of)(const peri__operands *o, int64_t place, int64_t first, uint64_t live,
                                                         peri__bunch *bunch, PERI_FN(pulled) *pulled, const int linear) {
    PERI_NO_CONTRACTION
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place), begin = m->start[i] + first;
    const int32_t reals = PERI_D == 3 ? 8 : m->record_reals, *ids = &m->ids[begin];
    const peri_r *records = (const peri_r *)o->records, *mine = records + place * reals;
    const peri_b *weights = (const peri_b *)m->weight + begin;
    const PERI_VECTOR tiny = PERI_V(set1)((peri_b)PERI_TINY);
    peri_b stretch[PERI_BUNCH], length[PERI_BUNCH];
    peri_r own[8] = { 0 };
    for (int d = 0; d < 2 * PERI_D; ++d) own[d] = mine[d];
    for (int32_t k = 0; k < bunch->count; k += PERI_WIDTH) {
        PERI_ISA_FN(piece) s;
        PERI_VECTOR bond, product, reach;
        PERI_ISA_FN(span)(&s, records, reals, ids + k, own, linear);
        reach = PERI_ISA_FN(roots)(&s, &bond, &product, 0, linear);
        PERI_V(storeu)(stretch + k, s.along / reach);
        PERI_V(storeu)(length + k, bond);
        PERI_V(storeu)(pulled->factor + k, PERI_V(loadu)(weights + k) * bond / (product + tiny));
        for (int d = 0; d < PERI_D; ++d) PERI_V(storeu)(pulled->y[d] + k, s.y[d]);
    }
    for (int32_t k = 0; k < bunch->count; ++k) {
        bunch->others[k] = m->order ? m->order[ids[k]] : ids[k];
        bunch->stretch[k] = (double)stretch[k];
        bunch->length[k] = (double)length[k];
    }
    for (int32_t k = 0; ~live && k < bunch->count; ++k)
        if (!(live >> k & 1)) bunch->stretch[k] = 0.0;
}

PERI_ISA_TARGET static void PERI_ISA_FN(list_stretch)(const peri__operands *o, int64_t place, int64_t first, uint64_t live,
                                                      peri__bunch *bunch, PERI_FN(pulled) *pulled) {
    if (o->linear) PERI_ISA_FN(stretch_of)(o, place, first, live, bunch, pulled, 1);
    else PERI_ISA_FN(stretch_of)(o, place, first, live, bunch, pulled, 0);
}

/* Adds the pull of the live bonds of a bunch to f, bond k in lane k % PERI_CHUNK. */
PERI_ISA_TARGET static void PERI_ISA_FN(law_sum)(const peri__bunch *bunch, const PERI_FN(pulled) *pulled, uint64_t live, peri_r *f) {
    PERI_NO_CONTRACTION
    PERI_STATE sum[PERI_D][PERI_PIECES];
    const peri_r none[PERI_WIDTH] = { 0 };
    PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n)
        for (int d = 0; d < PERI_D; ++d) sum[d][n] = PERI_ISA_FN(take)(none);
    for (int32_t k = 0; k < bunch->count; k += PERI_CHUNK)
        PERI_PIECEWISE for (int n = 0; n < PERI_PIECES; ++n) {
            const int32_t at = k + n * PERI_WIDTH;
            const PERI_LIVE lanes = PERI_TO_LIVE((uint32_t)(live >> at));
            const PERI_VECTOR factor = PERI_V(loadu)(pulled->factor + at);
            for (int d = 0; d < PERI_D; ++d) {
                const PERI_VECTOR y = PERI_V(loadu)(pulled->y[d] + at);
                PERI_ISA_FN(gather)(&sum[d][n], PERI_KEEP_PRODUCT(lanes, factor, y));
            }
        }
    for (int d = 0; d < PERI_D; ++d) f[d] += PERI_ISA_FN(added)(sum[d]);
}

#undef PERI_PIECES
#undef PERI_VECTOR
#undef PERI_WIDTH
#undef PERI_V
#undef PERI_LIVE
#undef PERI_TO_LIVE
#undef PERI_KEEP
#undef PERI_KEEP_PRODUCT
#undef PERI_FREE_CHOICE
#undef PERI_ABOVE
#undef PERI_STATE
