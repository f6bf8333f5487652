/* k_list.inl - bond-based and ordinary state-based force on the list: the equations of k_bond.inl and k_state.inl for PERI_CHUNK bonds of a
   row at once, in pieces of PERI_WIDTH lanes by the operations of k_vector.inl. Bond k of a row is added in lane k % PERI_CHUNK, and lanes
   are added up in halves: the same bits from every instruction set and any number of threads. Bonds that come near their critical stretch
   are left to the rows. Included per real type, dimension and instruction set.

   What is needed of a neighbour lies side by side in its record, body->pack, m->slots reals: x, u, then p and q, or its material. */

typedef struct PERI_LANES_FN(piece) { /* PERI_WIDTH bonds                                                                 */
    PERI_VECTOR got[8];               /* the records of the neighbours                                                   */
    PERI_VECTOR y[PERI_D], along;     /* as in k_lanes.inl                                                               */
    PERI_VECTOR rest, now;            /* |xi|^2, |y|^2                                                                   */
} PERI_LANES_FN(piece);

PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(span)(PERI_LANES_FN(piece) *s, const peri_r *pack, int32_t slots, const int32_t *ids,
                                                       const peri_r *own, const int linear) {
    PERI_NO_CONTRACTION
    PERI_FETCH(pack, slots, ids, s->got);
    if (slots > 4) PERI_FETCH(pack + 4, slots, ids, s->got + 4);
    else s->got[4] = s->got[0]; /* not used, but copied */
    for (int d = 0; d < PERI_D; ++d) {
        const PERI_VECTOR xi = PERI_V(sub)(s->got[d], PERI_V(set1)(own[d]));
        const PERI_VECTOR eta = PERI_V(sub)(s->got[PERI_D + d], PERI_V(set1)(own[PERI_D + d]));
        const PERI_VECTOR along = PERI_V(mul)(linear ? xi : PERI_V(add)(PERI_V(add)(xi, xi), eta), eta), rest = PERI_V(mul)(xi, xi);
        s->y[d] = linear ? xi : PERI_V(add)(xi, eta);
        s->along = d == 0 ? along : PERI_V(add)(s->along, along);
        s->rest = d == 0 ? rest : PERI_V(add)(s->rest, rest);
        if (linear) continue;
        const PERI_VECTOR now = PERI_V(mul)(s->y[d], s->y[d]);
        s->now = d == 0 ? now : PERI_V(add)(s->now, now);
    }
    if (linear) s->now = s->rest;
}

PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(chunk)(PERI_LANES_FN(piece) *s, const peri_r *pack, int32_t slots, const int32_t *ids,
                                                        const peri_r *own, const int linear) {
    for (int n = 0; n < PERI_CHUNK / PERI_WIDTH; ++n) PERI_LANES_FN(span)(s + n, pack, slots, ids + n * PERI_WIDTH, own, linear);
}

/* product: |xi| |y|; returns R = |xi| (|y| + |xi|). Then |xi| e = |xi|^2 along/R, and LPS, whose gauge is |xi|, needs no square root but
   that of |xi|^2 |y|^2: `bond` is |xi|^2 with LPS, and |xi| else. */
PERI_LANES_TARGET PERI_INLINE PERI_VECTOR PERI_LANES_FN(roots)(const PERI_LANES_FN(piece) *s, PERI_VECTOR *bond, PERI_VECTOR *product,
                                                               const int model, const int linear) {
    PERI_NO_CONTRACTION
    *bond = model == PERI_LPS ? s->rest : PERI_V(sqrt)(s->rest);
    if (linear) *product = s->rest;
    else if (model == PERI_LPS) *product = PERI_V(sqrt)(PERI_V(mul)(s->rest, s->now));
    else *product = PERI_V(mul)(*bond, PERI_V(sqrt)(s->now));
    return linear ? s->rest : PERI_V(add)(*product, s->rest);
}

/* Flags of the PERI_CHUNK bonds of row i from bond k on. */
PERI_INLINE uint32_t PERI_LANES_FN(live)(const peri_body *b, int64_t i, int64_t k, int64_t count) {
    const uint32_t flags = b->alive ? b->alive[i * b->model->words + k / 32] >> (k % 32) : ~(uint32_t)0;
    return flags & (((uint32_t)1 << (count - k < PERI_CHUNK ? count - k : PERI_CHUNK)) - 1);
}

PERI_LANES_TARGET PERI_INLINE peri_r PERI_LANES_FN(added)(const PERI_VECTOR *sum) {
    peri_r lane[PERI_CHUNK];
    for (int l = 0; l < PERI_CHUNK; l += PERI_WIDTH) PERI_V(storeu)(lane + l, sum[l / PERI_WIDTH]);
    for (int half = PERI_CHUNK / 2; half > 0; half /= 2)
        for (int l = 0; l < half; ++l) lane[l] += lane[l + half];
    return lane[0];
}

/* Adds the force of all live bonds of the point at a place to f, all points being of one model. Returns nonzero where a bond comes near its
   critical stretch; f is then void. `model` and `linear` are constants where this is inlined. */
PERI_LANES_TARGET PERI_INLINE int PERI_LANES_FN(list_row)(const peri__step *step, int64_t place, peri_r *f, const int model,
                                                          const int linear) {
    PERI_NO_CONTRACTION
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const int states = model != PERI_BOND_BASED, mixed = PERI_D == 2 ? m->slots > 4 : m->materials > 1;
    const int32_t slots = states || PERI_D == 3 ? 8 : m->slots;
    const peri_r *pack = (const peri_r *)b->pack, *own = pack + place * slots;
    const peri_r *weights = (const peri_r *)m->weight + first, *backs = (const peri_r *)m->back + first;
    const PERI_VECTOR limit = PERI_V(set1)((peri_r)(step->breaking ? PERI_FN(least_stretch)(b, i) * (1.0 - PERI_NEAR) : PERI_NEVER));
    const PERI_VECTOR tiny = PERI_V(set1)((peri_r)PERI_TINY);
    const PERI_VECTOR pi = PERI_V(set1)(states ? own[2 * PERI_D] : 0), qi = PERI_V(set1)(states ? own[2 * PERI_D + 1] : 0);
    const int32_t *ids = &m->ids[first];
    PERI_LANES_FN(piece) next[PERI_CHUNK / PERI_WIDTH];
    PERI_VECTOR sum[PERI_D][PERI_CHUNK / PERI_WIDTH], c = PERI_V(set1)((peri_r)m->pairs->c);
    peri_r table[PERI_MATERIAL_LIMIT], pick[PERI_WIDTH];
    int hit = 0;
    for (int32_t k = 0; !states && mixed && k < m->materials; ++k)
        table[k] = (peri_r)m->pairs[m->material[i] * m->materials + k].c;
    for (int n = 0; n < PERI_CHUNK / PERI_WIDTH; ++n)
        for (int d = 0; d < PERI_D; ++d) sum[d][n] = PERI_V(set1)(0);
    PERI_LANES_FN(chunk)(next, pack, slots, ids, own, linear);
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_LANES_FN(live)(b, i, k, count);
        PERI_LANES_FN(piece) now[PERI_CHUNK / PERI_WIDTH];
        for (int n = 0; n < PERI_CHUNK / PERI_WIDTH; ++n) now[n] = next[n];
        if (k + PERI_CHUNK < count) PERI_LANES_FN(chunk)(next, pack, slots, ids + k + PERI_CHUNK, own, linear);
        for (int n = 0; n < PERI_CHUNK / PERI_WIDTH; ++n) {
            const int64_t at = k + n * PERI_WIDTH;
            const PERI_LIVE live = PERI_TO_LIVE(flags >> (n * PERI_WIDTH));
            const PERI_VECTOR weight = PERI_V(loadu)(weights + at);
            const PERI_LANES_FN(piece) s = now[n];
            PERI_VECTOR scale, bond, product, reach;
            reach = PERI_LANES_FN(roots)(&s, &bond, &product, model, linear);
            if (states) { /* w (p g + q e)/|y| */
                const PERI_VECTOR back = PERI_V(loadu)(backs + at);
                const PERI_VECTOR p = PERI_V(add)(PERI_V(mul)(weight, pi), PERI_V(mul)(back, s.got[2 * PERI_D]));
                const PERI_VECTOR q = PERI_V(add)(PERI_V(mul)(weight, qi), PERI_V(mul)(back, s.got[2 * PERI_D + 1]));
                scale = PERI_V(mul)(q, s.along);
                if (model == PERI_OTERKUS) scale = PERI_V(mul)(scale, bond);
                scale = PERI_V(mul)(bond, PERI_V(add)(scale, PERI_V(mul)(p, reach)));
            } else { /* c w e/(|xi| |y|) */
                if (mixed) {
                    PERI_V(storeu)(pick, s.got[2 * PERI_D]);
                    for (int l = 0; l < PERI_WIDTH; ++l) pick[l] = table[(int)pick[l]];
                    c = PERI_V(loadu)(pick);
                }
                scale = PERI_V(mul)(PERI_V(mul)(PERI_V(mul)(c, weight), s.along), bond);
            }
            scale = PERI_V(div)(scale, PERI_V(add)(PERI_V(mul)(reach, product), tiny));
            hit |= (int)PERI_ABOVE(s.along, PERI_V(mul)(limit, reach), live);
            for (int d = 0; d < PERI_D; ++d) /* a choice: what a dead lane read may be anything */
                sum[d][n] = PERI_V(add)(sum[d][n], PERI_KEEP(live, PERI_V(mul)(scale, s.y[d])));
        }
    }
    for (int d = 0; d < PERI_D; ++d) f[d] += PERI_LANES_FN(added)(sum[d]);
    return hit;
}

PERI_LANES_TARGET static int PERI_LANES_FN(list_force)(const peri__step *step, int64_t place, peri_r *f) {
    return step->body->desc.geometry == PERI_LINEAR ? PERI_LANES_FN(list_row)(step, place, f, PERI_BOND_BASED, 1)
                                                    : PERI_LANES_FN(list_row)(step, place, f, PERI_BOND_BASED, 0);
}

PERI_LANES_TARGET static int PERI_LANES_FN(list_share)(const peri__step *step, int64_t place, peri_r *f) {
    const int linear = step->body->desc.geometry == PERI_LINEAR;
    if (step->body->model->ordinary == PERI_LPS)
        return linear ? PERI_LANES_FN(list_row)(step, place, f, PERI_LPS, 1) : PERI_LANES_FN(list_row)(step, place, f, PERI_LPS, 0);
    return linear ? PERI_LANES_FN(list_row)(step, place, f, PERI_OTERKUS, 1) : PERI_LANES_FN(list_row)(step, place, f, PERI_OTERKUS, 0);
}

/* sum w g e V of the point at a place. */
PERI_LANES_TARGET PERI_INLINE peri_r PERI_LANES_FN(list_sum)(const peri_body *b, int64_t place, const int model, const int linear) {
    PERI_NO_CONTRACTION
    const peri__model *m = b->model;
    const int64_t i = peri__nth(m, place), first = m->start[i], count = m->count[i];
    const peri_r *pack = (const peri_r *)b->pack, *weights = (const peri_r *)m->weight + first;
    const int32_t *ids = &m->ids[first];
    PERI_LANES_FN(piece) next[PERI_CHUNK / PERI_WIDTH];
    PERI_VECTOR sum[PERI_CHUNK / PERI_WIDTH];
    for (int n = 0; n < PERI_CHUNK / PERI_WIDTH; ++n) sum[n] = PERI_V(set1)(0);
    PERI_LANES_FN(chunk)(next, pack, 8, ids, pack + place * 8, linear);
    for (int64_t k = 0; k < count; k += PERI_CHUNK) {
        const uint32_t flags = PERI_LANES_FN(live)(b, i, k, count);
        PERI_LANES_FN(piece) now[PERI_CHUNK / PERI_WIDTH];
        for (int n = 0; n < PERI_CHUNK / PERI_WIDTH; ++n) now[n] = next[n];
        if (k + PERI_CHUNK < count) PERI_LANES_FN(chunk)(next, pack, 8, ids + k + PERI_CHUNK, pack + place * 8, linear);
        for (int n = 0; n < PERI_CHUNK / PERI_WIDTH; ++n) {
            PERI_VECTOR part = PERI_V(loadu)(weights + k + n * PERI_WIDTH), bond, product, reach;
            const PERI_LANES_FN(piece) s = now[n];
            part = PERI_V(mul)(part, s.along);
            if (!linear || model != PERI_LPS) {
                reach = PERI_LANES_FN(roots)(&s, &bond, &product, model, linear);
                part = PERI_V(div)(PERI_V(mul)(part, bond), reach);
            }
            sum[n] = PERI_V(add)(sum[n], PERI_KEEP(PERI_TO_LIVE(flags >> (n * PERI_WIDTH)), part));
        }
    }
    return PERI_LANES_FN(added)(sum);
}

PERI_LANES_TARGET static peri_r PERI_LANES_FN(list_stretched)(const peri_body *b, int64_t place) {
    const int linear = b->desc.geometry == PERI_LINEAR;
    if (b->model->ordinary == PERI_LPS)
        return linear ? PERI_LANES_FN(list_sum)(b, place, PERI_LPS, 1) : PERI_LANES_FN(list_sum)(b, place, PERI_LPS, 0);
    return linear ? PERI_LANES_FN(list_sum)(b, place, PERI_OTERKUS, 1) : PERI_LANES_FN(list_sum)(b, place, PERI_OTERKUS, 0);
}

#undef PERI_FETCH
#undef PERI_VECTOR
#undef PERI_WIDTH
#undef PERI_V
#undef PERI_LIVE
#undef PERI_TO_LIVE
#undef PERI_KEEP
#undef PERI_ABOVE
