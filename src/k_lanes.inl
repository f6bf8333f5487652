/* k_lanes.inl - the bond-based force on columns (lanes.c): the equation of k_bond.inl for PERI_LANES points at once, operation by operation
   in the same order, so with the same result. Included per real type, dimension and instruction set; PERI_LANES_FN names it. */

/* One column: bond vector xi, |xi| = bond, weight = c w beta V, breaking beyond along > limit*reach; masked and linear are constants where
   this is inlined. */
PERI_LANES_TARGET PERI_INLINE void PERI_LANES_FN(column)(const peri_r *xi, peri_r bond, peri_r weight, peri_r limit, peri_i mask,
                                                         const peri_r *const *uj, peri_r ui[PERI_D][PERI_LANES],
                                                         peri_r sum[PERI_D][PERI_LANES], peri_i *hit, const int masked,
                                                         const int linear) {
    PERI_NO_CONTRACTION
    peri_r y[PERI_D][PERI_LANES], along[PERI_LANES], length[PERI_LANES];
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
    for (int l = 0; l < PERI_LANES; ++l) {
        const peri_i live = masked ? mask >> l & 1 : 1;
        peri_r now = linear ? bond : length[l], reach = linear ? bond : now + bond;
        peri_r scale = weight * along[l] / (reach * bond * now + PERI_TINY);
        scale = live ? scale : 0; /* a select: what a dead lane read may be anything */
        hit[l] |= (along[l] > limit * reach) & live;
        for (int d = 0; d < PERI_D; ++d) sum[d][l] += scale * y[d][l];
    }
}

/* Adds the force of all live bonds of group g to f[PERI_D][PERI_LANES]. Returns nonzero where a live bond comes so near its critical
   stretch that the list must decide; f is then void. */
PERI_LANES_TARGET static int PERI_LANES_FN(lanes)(const peri__step *step, int64_t g, peri_r f[PERI_D][PERI_LANES]) {
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri__lanes *lanes = &m->lanes;
    const uint16_t *masks = b->lanes_alive ? b->lanes_alive : lanes->member;
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
    for (int64_t column = lanes->begin[g]; column < lanes->begin[g + 1]; ++column) {
        const double *row = &lanes->table[lanes->vector[column] * PERI_TABLE_ROW];
        const peri_r *uj[PERI_D], bond = (peri_r)row[3], weight = c * (peri_r)row[4], limit = s0 * bond;
        const peri_i mask = masks[column];
        peri_r xi[PERI_D];
        for (int d = 0; d < PERI_D; ++d) {
            xi[d] = (peri_r)row[d];
            uj[d] = u + d * m->stride + lanes->offset[column];
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

#undef PERI_LANES_SQRT
#undef PERI_LANES_FN
#undef PERI_LANES_TARGET
