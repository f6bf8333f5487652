/* k_lanes.inl - bond-based and ordinary state-based force on columns (lanes.c): the equations of k_bond.inl and k_state.inl for PERI_LANES
   points at once, operation by operation in the same order, so with the same result. Included per real type, dimension and instruction
   set; PERI_LANES_FN names it. Arguments `masked`, `linear`, ... are constants where these are inlined. */

/* One column: bond vector xi. along = (2 xi + eta).eta, or xi.eta; length = |y|. */
PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(extend)(const peri_r *xi, peri_r bond, const peri_r *const *uj,
                                                         peri_r ui[PERI_D][PERI_LANES], peri_r y[PERI_D][PERI_LANES],
                                                         peri_r along[PERI_LANES], peri_r length[PERI_LANES], const int linear) {
    PERI_NO_CONTRACTION
    for (int l = 0; l < PERI_LANES; ++l) {
        along[l] = length[l] = 0;
        for (int d = 0; d < PERI_D; ++d) {
            peri_r eta = uj[d][l] - ui[d][l];
            y[d][l] = linear ? xi[d] : xi[d] + eta;
            along[l] += (linear ? xi[d] : 2 * xi[d] + eta) * eta;
            length[l] += y[d][l] * y[d][l];
        }
    }
    if (!linear) PERI_LANES_SQRT(length);
    for (int l = 0; linear && l < PERI_LANES; ++l) length[l] = bond;
}

/* One column of bond-based bonds: |xi| = bond, weight = c w beta V, breaking beyond along > limit*reach. */
PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(column)(const peri_r *xi, peri_r bond, peri_r weight, peri_r limit, peri_i mask,
                                                         const peri_r *const *uj, peri_r ui[PERI_D][PERI_LANES],
                                                         peri_r sum[PERI_D][PERI_LANES], peri_i *hit, const int masked,
                                                         const int linear) {
    PERI_NO_CONTRACTION
    peri_r y[PERI_D][PERI_LANES], along[PERI_LANES], length[PERI_LANES];
    PERI_LANES_FN(extend)(xi, bond, uj, ui, y, along, length, linear);
    for (int l = 0; l < PERI_LANES; ++l) {
        const peri_i live = masked ? mask >> l & 1 : 1;
        peri_r reach = linear ? bond : length[l] + bond;
        peri_r scale = weight * along[l] / (reach * bond * length[l] + PERI_TINY);
        scale = live ? scale : 0; /* a select: what a dead lane read may be anything */
        hit[l] |= (along[l] > limit * reach) & live;
        for (int d = 0; d < PERI_D; ++d) sum[d][l] += scale * y[d][l];
    }
}

/* Adds the force of all live bonds of group g to f[PERI_D][PERI_LANES]. Returns nonzero where a live bond comes so near its critical
   stretch that the rows must decide; f is then void. */
PERI_LANES_TARGET static int PERI_LANES_FN(lanes)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES]) {
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri__lanes *lanes = &m->lanes;
    const uint16_t *alive = b->lanes_alive ? &b->lanes_alive[lanes->begin[g]] : NULL;
    const peri__column *columns = &lanes->column[lanes->first[g]], *end = columns + (lanes->begin[g + 1] - lanes->begin[g]);
    const peri_r *u = (const peri_r *)b->u + g * PERI_LANES;
    const peri_r c = (peri_r)b->pairs->c, s0 = (peri_r)(step->breaking ? b->pairs->s0 * (1.0 - PERI_NEAR) : PERI_NEVER);
    const int linear = b->desc.geometry == PERI_LINEAR;
    peri_r ui[PERI_D][PERI_LANES], sum[PERI_D][PERI_LANES];
    peri_i hit[PERI_LANES];
    int any = 0;
    for (int l = 0; l < PERI_LANES; ++l) hit[l] = 0;
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) {
            ui[d][l] = u[d * m->stride + l];
            sum[d][l] = f[d][l];
        }
    for (const peri__column *column = columns; column < end; ++column) {
        const double *row = &lanes->table[column->vector * PERI_TABLE_ROW];
        const peri_r *uj[PERI_D], bond = (peri_r)row[3], weight = c * (peri_r)row[4], limit = s0 * bond;
        const peri_i mask = alive ? *alive++ : column->member;
        peri_r xi[PERI_D];
        for (int d = 0; d < PERI_D; ++d) {
            xi[d] = (peri_r)row[d];
            uj[d] = u + d * m->stride + column->offset;
        }
        if (mask == 0xFFFF) {
            if (linear) PERI_LANES_FN(column)(xi, bond, weight, limit, mask, uj, ui, sum, hit, 0, 1);
            else PERI_LANES_FN(column)(xi, bond, weight, limit, mask, uj, ui, sum, hit, 0, 0);
        } else if (mask != 0) {
            if (linear) PERI_LANES_FN(column)(xi, bond, weight, limit, mask, uj, ui, sum, hit, 1, 1);
            else PERI_LANES_FN(column)(xi, bond, weight, limit, mask, uj, ui, sum, hit, 1, 0);
        }
    }
    for (int l = 0; l < PERI_LANES; ++l) any |= (int)hit[l];
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) f[d][l] = sum[d][l];
    return any;
}

/* sum w g e V of the points of group g to sum; weight of a column times `gauged` ? |xi| : 1. */
PERI_LANES_TARGET static void PERI_LANES_FN(stretched)(const peri_body *b, int64_t g, const int gauged, peri_r sum[PERI_LANES]) {
    PERI_NO_CONTRACTION
    const peri__model *m = b->model;
    const peri__lanes *lanes = &m->lanes;
    const uint16_t *alive = b->lanes_alive ? &b->lanes_alive[lanes->begin[g]] : NULL;
    const peri__column *columns = &lanes->column[lanes->first[g]], *end = columns + (lanes->begin[g + 1] - lanes->begin[g]);
    const peri_r *u = (const peri_r *)b->u + g * PERI_LANES;
    const int linear = b->desc.geometry == PERI_LINEAR;
    peri_r ui[PERI_D][PERI_LANES], y[PERI_D][PERI_LANES], along[PERI_LANES], length[PERI_LANES];
    for (int l = 0; l < PERI_LANES; ++l) sum[l] = 0;
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) ui[d][l] = u[d * m->stride + l];
    for (const peri__column *column = columns; column < end; ++column) {
        const double *row = &lanes->table[column->vector * PERI_TABLE_ROW];
        const peri_r *uj[PERI_D], bond = (peri_r)row[3], weight = (peri_r)row[4] * (gauged ? bond : 1);
        const peri_i mask = alive ? *alive++ : column->member;
        peri_r xi[PERI_D];
        if (mask == 0) continue;
        for (int d = 0; d < PERI_D; ++d) {
            xi[d] = (peri_r)row[d];
            uj[d] = u + d * m->stride + column->offset;
        }
#define PERI_ADD(line, whole)                                                                                          \
    PERI_LANES_FN(extend)(xi, bond, uj, ui, y, along, length, line);                                                   \
    for (int l = 0; l < PERI_LANES; ++l) {                                                                             \
        peri_r part = weight * (along[l] / ((line) ? bond : length[l] + bond));                                        \
        sum[l] += (whole) || (mask >> l & 1) ? part : 0;                                                               \
    }
        if (mask == 0xFFFF) {
            if (linear) { PERI_ADD(1, 1) } else { PERI_ADD(0, 1) }
        } else {
            if (linear) { PERI_ADD(1, 0) } else { PERI_ADD(0, 0) }
        }
#undef PERI_ADD
    }
}

/* One column of ordinary state-based bonds: p, q of both ends; gauge = |xi|, or 1. */
PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(share_column)(const peri_r *xi, peri_r bond, peri_r weight, peri_r gauge, peri_r limit,
                                                               peri_i mask, const peri_r *const *uj, const peri_r *pj, const peri_r *qj,
                                                               peri_r ui[PERI_D][PERI_LANES], const peri_r *pi, const peri_r *qi,
                                                               peri_r sum[PERI_D][PERI_LANES], peri_i *hit, const int masked,
                                                               const int linear) {
    PERI_NO_CONTRACTION
    peri_r y[PERI_D][PERI_LANES], along[PERI_LANES], length[PERI_LANES];
    PERI_LANES_FN(extend)(xi, bond, uj, ui, y, along, length, linear);
    for (int l = 0; l < PERI_LANES; ++l) {
        const peri_i live = masked ? mask >> l & 1 : 1;
        peri_r reach = linear ? bond : length[l] + bond;
        peri_r pull = (qi[l] + qj[l]) * along[l] + (pi[l] + pj[l]) * gauge * reach;
        peri_r scale = weight * pull / (reach * length[l] + PERI_TINY);
        scale = live ? scale : 0;
        hit[l] |= (along[l] > limit * reach) & live;
        for (int d = 0; d < PERI_D; ++d) sum[d][l] += scale * y[d][l];
    }
}

/* Adds the force of all live state-based bonds of group g to f. Returns nonzero where one comes near its critical stretch; f is then
   void. */
PERI_LANES_TARGET static int PERI_LANES_FN(share)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES]) {
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri__lanes *lanes = &m->lanes;
    const uint16_t *alive = b->lanes_alive ? &b->lanes_alive[lanes->begin[g]] : NULL;
    const peri__column *columns = &lanes->column[lanes->first[g]], *end = columns + (lanes->begin[g + 1] - lanes->begin[g]);
    const peri_r *u = (const peri_r *)b->u + g * PERI_LANES, *p = (const peri_r *)b->response + m->margin + g * PERI_LANES;
    const peri_r *q = (const peri_r *)b->constant + m->margin + PERI__SPRING * m->stride + g * PERI_LANES;
    const peri_r s0 = (peri_r)(step->breaking ? b->pairs->s0 * (1.0 - PERI_NEAR) : PERI_NEVER);
    const int linear = b->desc.geometry == PERI_LINEAR, oterkus = m->ordinary == PERI_OTERKUS;
    peri_r ui[PERI_D][PERI_LANES], sum[PERI_D][PERI_LANES], pi[PERI_LANES], qi[PERI_LANES];
    peri_i hit[PERI_LANES];
    int any = 0;
    for (int l = 0; l < PERI_LANES; ++l) {
        hit[l] = 0;
        pi[l] = p[l];
        qi[l] = q[l];
    }
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) {
            ui[d][l] = u[d * m->stride + l];
            sum[d][l] = f[d][l];
        }
    for (const peri__column *column = columns; column < end; ++column) {
        const double *row = &lanes->table[column->vector * PERI_TABLE_ROW];
        const int64_t offset = column->offset;
        const peri_r *uj[PERI_D], bond = (peri_r)row[3], weight = (peri_r)row[4], limit = s0 * bond, gauge = oterkus ? 1 : bond;
        const peri_i mask = alive ? *alive++ : column->member;
        peri_r xi[PERI_D];
        if (mask == 0) continue;
        for (int d = 0; d < PERI_D; ++d) {
            xi[d] = (peri_r)row[d];
            uj[d] = u + d * m->stride + offset;
        }
#define PERI_COLUMN(masked, line)                                                                                      \
    PERI_LANES_FN(share_column)(xi, bond, weight, gauge, limit, mask, uj, p + offset, q + offset, ui, pi, qi, sum, hit, masked, line)
        if (mask == 0xFFFF) {
            if (linear) PERI_COLUMN(0, 1);
            else PERI_COLUMN(0, 0);
        } else {
            if (linear) PERI_COLUMN(1, 1);
            else PERI_COLUMN(1, 0);
        }
#undef PERI_COLUMN
    }
    for (int l = 0; l < PERI_LANES; ++l) any |= (int)hit[l];
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) f[d][l] = sum[d][l];
    return any;
}

/* sum w eta xi V of correspondence points. */
PERI_LANES_TARGET static void PERI_LANES_FN(shape)(const peri_body *b, int64_t g, peri_r n[PERI_D][PERI_D][PERI_LANES]) {
    PERI_NO_CONTRACTION
    const peri__model *m = b->model;
    const peri__lanes *lanes = &m->lanes;
    const uint16_t *alive = b->lanes_alive ? &b->lanes_alive[lanes->begin[g]] : NULL;
    const peri__column *columns = &lanes->column[lanes->first[g]], *end = columns + (lanes->begin[g + 1] - lanes->begin[g]);
    const peri_r *u = (const peri_r *)b->u + g * PERI_LANES;
    peri_r ui[PERI_D][PERI_LANES];
    for (int a = 0; a < PERI_D; ++a)
        for (int l = 0; l < PERI_LANES; ++l) {
            ui[a][l] = u[a * m->stride + l];
            for (int d = 0; d < PERI_D; ++d) n[a][d][l] = 0;
        }
    for (const peri__column *column = columns; column < end; ++column) {
        const double *row = &lanes->table[column->vector * PERI_TABLE_ROW];
        const peri_r *uj = u + column->offset, weight = (peri_r)row[4];
        const peri_i mask = alive ? *alive++ : column->member;
        peri_r xi[PERI_D];
        if (mask == 0) continue;
        for (int d = 0; d < PERI_D; ++d) xi[d] = (peri_r)row[d];
        for (int a = 0; a < PERI_D; ++a)
            for (int l = 0; l < PERI_LANES; ++l) {
                peri_r pulled = mask >> l & 1 ? weight * (uj[a * m->stride + l] - ui[a][l]) : 0;
                for (int d = 0; d < PERI_D; ++d) n[a][d][l] += pulled * xi[d];
            }
    }
}

/* Adds the force of all live bonds of a group of correspondence points to f, w ((Q_i + Q_j) xi + (k_i + k_j) eta); no central bonds.
   Returns nonzero where a bond comes near its critical stretch, (2 xi + eta).eta > s0 (2 + s0) |xi|^2 or xi.eta > s0 |xi|^2. */
PERI_LANES_TARGET static int PERI_LANES_FN(tensor)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES]) {
    PERI_NO_CONTRACTION
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri__lanes *lanes = &m->lanes;
    const uint16_t *alive = b->lanes_alive ? &b->lanes_alive[lanes->begin[g]] : NULL;
    const peri__column *columns = &lanes->column[lanes->first[g]], *end = columns + (lanes->begin[g + 1] - lanes->begin[g]);
    const peri_r *u = (const peri_r *)b->u + g * PERI_LANES, *q = (const peri_r *)b->response + m->margin + m->stride + g * PERI_LANES;
    const peri_r *k = (const peri_r *)b->constant + m->margin + PERI__VECTOR * m->stride + g * PERI_LANES;
    const int linear = b->desc.geometry == PERI_LINEAR;
    const double near_s0 = b->pairs->s0 * (1.0 - PERI_NEAR), stretched = linear ? near_s0 : near_s0 * (2.0 + near_s0);
    peri_r ui[PERI_D][PERI_LANES], qi[PERI_D][PERI_D][PERI_LANES], ki[PERI_LANES];
    peri_i hit[PERI_LANES];
    int any = 0;
    for (int l = 0; l < PERI_LANES; ++l) {
        hit[l] = 0;
        ki[l] = k[l];
        for (int a = 0; a < PERI_D; ++a) {
            ui[a][l] = u[a * m->stride + l];
            for (int d = 0; d < PERI_D; ++d) qi[a][d][l] = q[(a * PERI_D + d) * m->stride + l];
        }
    }
    for (const peri__column *column = columns; column < end; ++column) {
        const double *row = &lanes->table[column->vector * PERI_TABLE_ROW];
        const int64_t offset = column->offset;
        const peri_r *uj = u + offset, *qj = q + offset, *kj = k + offset, weight = (peri_r)row[4];
        const peri_r limit = step->breaking && b->pairs->s0 < PERI_NEVER ? (peri_r)(stretched * row[3] * row[3]) : (peri_r)PERI_NEVER;
        const peri_i mask = alive ? *alive++ : column->member;
        peri_r xi[PERI_D], t[PERI_D][PERI_LANES], reach[PERI_LANES];
        if (mask == 0) continue;
        for (int d = 0; d < PERI_D; ++d) xi[d] = (peri_r)row[d];
        for (int l = 0; l < PERI_LANES; ++l) reach[l] = 0;
        for (int a = 0; a < PERI_D; ++a)
            for (int l = 0; l < PERI_LANES; ++l) {
                const peri_r eta = uj[a * m->stride + l] - ui[a][l];
                t[a][l] = (ki[l] + kj[l]) * eta;
                for (int d = 0; d < PERI_D; ++d) t[a][l] += (qi[a][d][l] + qj[(a * PERI_D + d) * m->stride + l]) * xi[d];
                reach[l] += (linear ? xi[a] : 2 * xi[a] + eta) * eta;
            }
        for (int l = 0; l < PERI_LANES; ++l) hit[l] |= (reach[l] > limit) & (mask >> l & 1);
        for (int a = 0; a < PERI_D; ++a)
            for (int l = 0; l < PERI_LANES; ++l) f[a][l] += mask >> l & 1 ? weight * t[a][l] : 0;
    }
    for (int l = 0; l < PERI_LANES; ++l) any |= (int)hit[l];
    return any;
}
