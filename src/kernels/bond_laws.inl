/* SPDX-License-Identifier: MIT */
/* bond_laws.inl - passes over bodies whose bonds follow laws of bonds (src/laws/bond_laws.c), by rows, PERI_BUNCH bonds at a time: their
   stretches are gathered, the laws asked for phi, and the forces c w phi M added up in the order of the row. */

/* The bonds from `first` on of row i: how they are deformed, and what their laws make of it. 0 where a law failed. */
static int PERI_FN(ask_laws)(const peri__operands *s, int64_t i, const peri__row *row, int64_t first, PERI_FN(bond) *bonds,
                             peri__bunch *bunch) {
    bunch->count = (int32_t)peri__min(row->count - first, PERI_BUNCH);
    for (int32_t n = 0; n < bunch->count; ++n) {
        PERI_FN(bond) *bond = &bonds[n];
        if (s->linear) PERI_FN(deform_as)(s, i, row, first + n, bond, 1, 0);
        else PERI_FN(deform_as)(s, i, row, first + n, bond, 0, 0);
        bunch->length[n] = (double)bond->length;
        bunch->stretch[n] = PERI_FN(is_live)(s, i, first + n) ? (double)(bond->along / (bond->length * bond->reach)) : 0.0;
    }
    return peri__respond(s, i, row, first, bunch);
}

/* Bonds that break do so at the end of the step: they still give it half a step of their force. Returns their number. */
static int32_t PERI_FN(law_bunch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t first, const PERI_FN(bond) *bonds,
                                  const peri__bunch *bunch, peri_r *sum, peri_r *impulse, double *lost) {
    const peri__model *m = s->model;
    int32_t broke = 0;
    for (int32_t n = 0; n < bunch->count; ++n) {
        const int64_t k = first + n;
        const PERI_FN(bond) *bond = &bonds[n];
        const peri__pair *pair = PERI_FN(pair)(s, i, row->ids[k]);
        const peri_b weight = ((const peri_b *)row->weight)[k];
        const peri_b pull = (peri_b)pair->c * weight * (peri_b)bunch->force[n] / (bond->now + PERI_TINY);
        if (!PERI_FN(is_live)(s, i, k)) continue;
        if (s->keeping) {
            const int lasting = s->point_class && (s->point_class[i] >= m->materials || s->point_class[row->ids[k]] >= m->materials);
            const int over = s->keeping > 1 && !lasting && (bunch->broken[n] || (s->breaking && bunch->stretch[n] > pair->s0));
            *lost += 0.5 * (double)(peri_b)pair->c * (double)weight * (double)bond->length
                   * (bunch->lost[n] + (over ? bunch->energy[n] : 0.0));
            if (over) {
                s->alive[i * m->words + k / 32] &= ~((uint32_t)1 << (k % 32));
                for (int d = 0; d < PERI_D; ++d) impulse[d] += (peri_r)(0.5 * s->step) * (peri_r)(pull * bond->y[d]);
                broke++;
                continue;
            }
        }
        for (int d = 0; d < PERI_D; ++d) sum[d] += pull * bond->y[d];
    }
    return broke;
}

/* As force_block. sums: also bad, the first point at which a law failed. */
static void PERI_FN(law_force)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *s = (const peri__operands *)context;
    const peri__model *m = s->model;
    PERI_FN(bond) bonds[PERI_BUNCH];
    peri__bunch bunch;
    peri__row row;
    bunch.asked = s->keeping ? PERI__ASK_HISTORY | PERI__ASK_ENERGY : 0;
    for (int64_t i = begin; i < end; ++i) {
        const peri_r portion = PERI_FN(portion)(m, i);
        peri_r sum[PERI_D] = { 0 }, impulse[PERI_D] = { 0 };
        int32_t broke = 0;
        double lost = 0.0;
        peri__row_of(m, i, &row);
        for (int64_t first = 0; first < row.count; first += PERI_BUNCH) {
            if (!PERI_FN(ask_laws)(s, i, &row, first, bonds, &bunch)) {
                sums->bad = sums->bad < 0 ? i : sums->bad;
                continue;
            }
            broke += PERI_FN(law_bunch)(s, i, &row, first, bonds, &bunch, sum, impulse, &lost);
        }
        for (int d = 0; d < PERI_D; ++d) ((peri_r *)s->f)[d * m->stride + i] += portion * sum[d];
        for (int d = 0; broke && s->closing && d < PERI_D; ++d) ((peri_r *)s->closing)[d * m->stride + i] = portion * impulse[d];
        sums->a += lost * m->volume[i] * (double)portion;
        sums->n += broke;
    }
}

/* As energy: what live bonds hold. */
static void PERI_FN(law_energy)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *s = (const peri__operands *)context;
    const peri__model *m = s->model;
    PERI_FN(bond) bonds[PERI_BUNCH];
    peri__bunch bunch;
    peri__row row;
    bunch.asked = PERI__ASK_ENERGY;
    for (int64_t i = begin; i < end; ++i) {
        double density = 0.0;
        peri__row_of(m, i, &row);
        for (int64_t first = 0; first < row.count; first += PERI_BUNCH) {
            if (!PERI_FN(ask_laws)(s, i, &row, first, bonds, &bunch)) {
                sums->bad = sums->bad < 0 ? i : sums->bad;
                continue;
            }
            for (int32_t n = 0; n < bunch.count; ++n)
                if (PERI_FN(is_live)(s, i, first + n))
                    density += 0.5 * PERI_FN(pair)(s, i, row.ids[first + n])->c * (double)((const peri_b *)row.weight)[first + n]
                             * (double)bonds[n].length * bunch.energy[n];
        }
        density /= peri__share(m, i);
        if (s->out) s->out[i] = density;
        sums->a += density * m->volume[i];
    }
}

#ifndef PERI_NO_STATICS
/* The change of the force density of points [begin, end) where the displacements change by ->p, to ->q:
   c w [phi' de/|xi| M + phi/|y| (d eta - M de)], de = M.d eta; the second part where the geometry is not linear. ->secant: phi/s for phi'. */
static void PERI_FN(law_tangent)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *s = (const peri__operands *)context;
    const peri__model *m = s->model;
    const peri_r *p = (const peri_r *)s->p;
    PERI_FN(bond) bonds[PERI_BUNCH];
    peri__bunch bunch;
    peri__row row;
    bunch.asked = PERI__ASK_TANGENT;
    for (int64_t i = begin; i < end; ++i) {
        peri_r sum[PERI_D] = { 0 };
        peri__row_of(m, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int32_t n = (int32_t)(k % PERI_BUNCH);
            const int64_t j = row.ids[k];
            if (n == 0 && !PERI_FN(ask_laws)(s, i, &row, k, bonds, &bunch)) {
                sums->bad = sums->bad < 0 ? i : sums->bad;
                break;
            }
            if (!PERI_FN(is_live)(s, i, k)) continue;
            const peri_r stiff = (peri_r)(PERI_FN(pair)(s, i, j)->c * (double)((const peri_b *)row.weight)[k]);
            const peri_r now = (peri_r)bonds[n].now + (peri_r)PERI_TINY, force = (peri_r)bunch.force[n];
            const peri_r slope = (peri_r)(s->secant ? peri__secant(bunch.stretch[n], bunch.force[n], bunch.tangent[n]) : bunch.tangent[n]);
            const peri_r across = s->linear ? 0 : stiff * force / now;
            peri_r y[PERI_D], delta[PERI_D], de = 0;
            for (int d = 0; d < PERI_D; ++d) {
                y[d] = (peri_r)bonds[n].y[d] / now;
                delta[d] = p[d * m->stride + j] - p[d * m->stride + i];
                de += y[d] * delta[d];
            }
            const peri_r along = stiff * slope / (peri_r)bonds[n].length * de;
            for (int d = 0; d < PERI_D; ++d) sum[d] += along * y[d] + across * (delta[d] - y[d] * de);
        }
        for (int d = 0; d < PERI_D; ++d) ((peri_r *)s->q)[d * m->stride + i] = sum[d] * PERI_FN(portion)(m, i);
    }
}
#endif
