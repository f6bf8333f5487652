/* SPDX-License-Identifier: MIT */
/* bond_laws.inl - passes over bodies whose bonds follow laws of bonds (src/laws/bond_laws.c), PERI_BUNCH bonds of a row at a time: their
   stretches are gathered, the laws asked for phi, and the forces c w phi M added up. Forces by the vectors of list.inl where there are
   records; all else by rows. */

/* The bonds from `first` on of row i: how they are deformed, and what their laws make of it. 0 where a law failed. */
static int PERI_FN(ask_laws)(const peri__operands *s, int64_t i, const peri__row *row, int64_t first, PERI_FN(bond) *bonds,
                             peri__bunch *bunch) {
    bunch->count = (int32_t)peri__min(row->count - first, PERI_BUNCH);
    for (int32_t n = 0; n < bunch->count; ++n) {
        PERI_FN(bond) *bond = &bonds[n];
        if (s->linear) PERI_FN(deform_as)(s, i, row, first + n, bond, 1, 0);
        else PERI_FN(deform_as)(s, i, row, first + n, bond, 0, 0);
        bunch->others[n] = row->ids[first + n];
        bunch->length[n] = (double)bond->length;
        bunch->stretch[n] = PERI_FN(is_live)(s, i, first + n) ? (double)(bond->along / (bond->length * bond->reach)) : 0.0;
    }
    return peri__respond(s, i, first, bunch);
}

/* What is lost of a bunch, and which bonds break: their flags are taken out of *live. They do so at the end of the step, and still give it
   half a step of their force, `pull` along y. Returns their number. */
static int32_t PERI_FN(break_bunch)(const peri__operands *s, int64_t i, int64_t first, peri__bunch *bunch, const peri_b *weights,
                                    uint64_t *live, double *lost) {
    const peri__model *m = s->model;
    int32_t broke = 0;
    for (int32_t n = 0; n < bunch->count; ++n) {
        const int64_t k = first + n, j = bunch->others[n];
        const peri__pair *pair = PERI_FN(pair)(s, i, j);
        const int lasting = s->point_class && (s->point_class[i] >= m->materials || s->point_class[j] >= m->materials);
        const int over = s->keeping > 1 && !lasting && (bunch->broken[n] || (s->breaking && bunch->stretch[n] > pair->s0));
        double gone = bunch->lost[n];
        if (!(*live >> n & 1) || (!over && gone == 0.0)) continue;
        if (over) {
            if (broke == 0) { /* rare: what is stored is asked for where it goes */
                peri__bunch again = *bunch;
                again.asked = PERI__ASK_ENERGY;
                if (peri__respond(s, i, first, &again)) memcpy(bunch->energy, again.energy, sizeof again.energy);
            }
            gone += bunch->energy[n];
            s->alive[i * m->words + k / 32] &= ~((uint32_t)1 << (k % 32));
            *live &= ~((uint64_t)1 << n);
            broke++;
        }
        *lost += 0.5 * (double)(peri_b)pair->c * (double)weights[n] * bunch->length[n] * gone;
    }
    return broke;
}

/* Flags of the bonds of row i from `first` on. */
static uint64_t PERI_FN(live_bunch)(const peri__operands *s, int64_t i, int64_t first, int32_t count) {
    const int64_t at = i * s->model->words + first / 32;
    uint64_t live = ~(uint64_t)0;
    if (s->alive) live = s->alive[at] | (count > 32 ? (uint64_t)s->alive[at + 1] << 32 : 0);
    return count < PERI_BUNCH ? live & (((uint64_t)1 << count) - 1) : live;
}

/* The force of point i to f, and to `impulse` what bonds that break still give. By rows, or from the list at `place`. */
static int32_t PERI_FN(law_point)(const peri__operands *s, int64_t i, int64_t place, peri_r *f, peri_r *impulse, double *lost,
                                  peri__sums *sums) {
    const peri__model *m = s->model;
    PERI_FN(bond) bonds[PERI_BUNCH];
    PERI_FN(pulled) pulled;
    peri__bunch bunch;
    peri__row row;
    int32_t broke = 0;
    bunch.asked = s->keeping ? PERI__ASK_HISTORY : 0;
    if (!m->record_reals) peri__row_of(m, i, &row);
    for (int64_t first = 0; first < m->count[i]; first += PERI_BUNCH) {
        bunch.count = (int32_t)peri__min(m->count[i] - first, PERI_BUNCH);
        uint64_t live = PERI_FN(live_bunch)(s, i, first, bunch.count);
        const uint64_t were = live;
        int ok;
        if (m->record_reals) {
            PERI_BY_VECTORS(m, list_stretch)(s, place, first, live, &bunch, &pulled);
            ok = peri__respond(s, i, first, &bunch);
        } else {
            ok = PERI_FN(ask_laws)(s, i, &row, first, bonds, &bunch);
            for (int32_t n = 0; n < bunch.count; ++n) {
                pulled.factor[n] = ((const peri_b *)row.weight)[first + n] / (bonds[n].now + PERI_TINY);
                for (int d = 0; d < PERI_D; ++d) pulled.y[d][n] = bonds[n].y[d];
            }
        }
        if (!ok) {
            sums->bad = sums->bad < 0 ? i : sums->bad;
            continue;
        }
        const peri_b *weights = m->record_reals ? (const peri_b *)m->weight + m->start[i] + first : (const peri_b *)row.weight + first;
        if (s->keeping) broke += PERI_FN(break_bunch)(s, i, first, &bunch, weights, &live, lost);
        for (int32_t n = 0; n < bunch.count; ++n)
            pulled.factor[n] *= (peri_b)(s->point_class ? PERI_FN(pair)(s, i, bunch.others[n])->c : s->pairs->c) * (peri_b)bunch.force[n];
        for (int32_t n = bunch.count; n < (bunch.count + PERI_CHUNK - 1) / PERI_CHUNK * PERI_CHUNK; ++n) pulled.factor[n] = 0;
        PERI_BY_VECTORS(m, law_sum)(&bunch, &pulled, live, f);
        for (int32_t n = 0; live != were && n < bunch.count; ++n)
            for (int d = 0; ((were & ~live) >> n & 1) && d < PERI_D; ++d)
                impulse[d] += (peri_r)(0.5 * s->step) * (peri_r)(pulled.factor[n] * pulled.y[d][n]);
    }
    return broke;
}

/* As force_block. sums: also bad, the first point at which a law failed. */
static void PERI_FN(law_force)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *s = (const peri__operands *)context;
    const peri__model *m = s->model;
    for (int64_t place = begin; place < end; ++place) {
        const int64_t i = m->record_reals ? peri__nth(m, place) : place;
        const peri_r portion = PERI_FN(portion)(m, i);
        peri_r sum[PERI_D] = { 0 }, impulse[PERI_D] = { 0 };
        double lost = 0.0;
        const int32_t broke = PERI_FN(law_point)(s, i, place, sum, impulse, &lost, sums);
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
   c w [phi' de/|xi| M + phi/|y| (d eta - M de)], de = M.d eta; the second part where the geometry is not linear. ->secant: phi/s instead of
   phi'. */
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
