/* SPDX-License-Identifier: MIT */
/* rows.inl - the passes over a row of Ibond, one bond at a time, for any mixture of laws, criteria and quadratures ([T] 1.20-1.23, 1.80;
   [P] 1, 9, 10; [C] 1-21). It is the reference, and what decides about bonds that are near breaking.

       e = |xi+eta| - |xi|,    M = (xi+eta)/|xi+eta|,    f_i = sum_j (T_i + T_j),    T_i = w [(p_i g + q_i e) M + Q_i xi + k_i eta]

   w includes beta V_j: `weight` is w_ij beta V_j, of the own half, `back` w_ji beta V_j, of that of j; or these times V_i, and sums are
   then taken times 1/V_i (`portion`). Seen from j the same sum has the opposite sign, term by term: momentum is conserved whatever the laws
   of the two ends are. Where bonds are in single precision rows round as the vectors that may serve the other end.
   The extension is taken as e = (2 xi + eta).eta/(|xi+eta| + |xi|): the difference of two lengths loses every digit at strains of 1e-7 in
   single precision, this form none. Each row adds its own bonds in the order of the list and writes only to its own point. Both ends of a
   bond compute the same e to the last bit (only signs differ), so both find it broken in the same step without telling each other. */

typedef struct PERI_FN(bond) { /* bond (i, j), deformed                                                                  */
    peri_b xi[PERI_D], eta[PERI_D];
    peri_b y[PERI_D];           /* along which its force acts: xi + eta, or xi where the geometry is linear              */
    peri_b length, now;         /* |xi|, |y|                                                                             */
    peri_b along, reach;        /* e = along/reach                                                                       */
} PERI_FN(bond);

/* Component d of xi of bond k of a row, where the places of its ends are `apart`. Points decide about the bonds that they share each for
   itself: they must take the same xi, and so must columns and rows. */
PERI_INLINE peri_b PERI_FN(xi_of)(const peri__row *row, int64_t k, int d, peri_r apart) {
    return row->vector ? (peri_b)row->table[row->vector[k]].xi[d] : (peri_b)apart;
}

PERI_INLINE int PERI_FN(is_live)(const peri__operands *s, int64_t i, int64_t k) {
    return !s->alive || (s->alive[i * s->model->words + k / 32] >> (k % 32) & 1);
}

/* xi and eta of bond k of row i. */
PERI_INLINE void PERI_FN(bond_vectors)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, peri_b *xi, peri_b *eta,
                                       const int centred) {
    const peri__model *m = s->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)s->u;
    const int64_t j = row->ids[k];
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *xd = x + d * m->stride, *ud = u + d * m->stride;
        xi[d] = centred ? ((const peri_b *)m->centroid)[(row->first + k) * PERI_D + d] : PERI_FN(xi_of)(row, k, d, xd[j] - xd[i]);
        eta[d] = (peri_b)(ud[j] - ud[i]);
    }
}

PERI_INLINE void PERI_FN(deform_as)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, PERI_FN(bond) *bond,
                                    const int linear,
                                    const int centred) {
    peri_b along = 0, square = 0;
    PERI_FN(bond_vectors)(s, i, row, k, bond->xi, bond->eta, centred);
    for (int d = 0; d < PERI_D; ++d) {
        const peri_b xi = bond->xi[d], eta = bond->eta[d];
        bond->y[d] = linear ? xi : xi + eta;
        along += (linear ? xi : 2 * xi + eta) * eta;
        square += bond->y[d] * bond->y[d];
    }
    bond->along = along;
    bond->length = ((const peri_b *)row->bond)[k];
    bond->now = linear ? bond->length : PERI_SQRT(square);
    bond->reach = linear ? bond->length : bond->now + bond->length;
}

/* As it is, eigenstrain aside. */
PERI_INLINE void PERI_FN(deform_whole)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, PERI_FN(bond) *bond) {
    PERI_FN(deform_as)(s, i, row, k, bond, s->linear, s->model->centroid != NULL);
}

/* The stretch beyond the mean eigenstrain of the ends: what criteria see. */
PERI_INLINE void PERI_FN(deform)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, PERI_FN(bond) *bond) {
    PERI_FN(deform_whole)(s, i, row, k, bond);
    if (s->eigenstrain) bond->along -= PERI_FN(mean_eigenstrain)(s, i, row->ids[k]) * (bond->length * bond->reach);
}

PERI_INLINE const peri__pair *PERI_FN(pair)(const peri__operands *s, int64_t i, int64_t j) {
    return s->point_class ? &s->pairs[s->point_class[i] * s->classes + s->point_class[j]] : s->pairs;
}

PERI_INLINE peri_b PERI_FN(constant)(const peri__operands *s, int plane, int64_t i) {
    return ((const peri_b *)s->constant)[plane * s->model->stride + i];
}

PERI_INLINE peri_b PERI_FN(response)(const peri__operands *s, int plane, int64_t i) {
    return ((const peri_b *)s->response)[plane * s->model->stride + i];
}

/* g of bonds at a point of a law. */
PERI_INLINE peri_b PERI_FN(gauge)(const peri__law *law, peri_b length) { return law->gauge ? length : 1; }

/* 1/V_i where weights are times V_i, see peri__share. */
PERI_INLINE peri_r PERI_FN(portion)(const peri__model *m, int64_t i) {
    return PERI_MUTUAL(m) ? ((const peri_r *)m->portion)[i] : 1;
}

#include "breaking.inl"

/* ---- the force ------------------------------------------------------------------------------------------------------ */

/* Adds what the tensors of the two ends give, w (Q xi + k eta), to t. */
#if PERI_T_BOND == 64
static void PERI_FN(tensor_pull)(const peri__operands *s, const int64_t ends[2], const peri_b weights[2], const PERI_FN(bond) *bond,
                                 peri_b *t) {
    const peri__model *m = s->model;
    for (int n = 0; n < 2; ++n) {
        if (!(m->laws[m->material[ends[n]]].gather & PERI__GRADIENT)) continue;
        for (int a = 0; a < PERI_D; ++a) {
            peri_b half = PERI_FN(constant)(s, PERI__STABILIZATION, ends[n]) * bond->eta[a];
            for (int d = 0; d < PERI_D; ++d) half += PERI_FN(response)(s, 1 + a * PERI_D + d, ends[n]) * bond->xi[d];
            half = weights[n] * half;
            t[a] += half;
        }
    }
}
#else
/* As list.inl, or as columns.inl. */
static void PERI_FN(tensor_pull)(const peri__operands *s, const int64_t ends[2], const peri_b weights[2], const PERI_FN(bond) *bond,
                                 peri_b *t) {
    const peri__model *m = s->model;
    const int listed = m->record_reals > 0 || m->back != m->weight;
    peri_b k[2], q[2][PERI_D * PERI_D];
    for (int n = 0; n < 2; ++n) {
        const int tensor = m->laws[m->material[ends[n]]].gather & PERI__GRADIENT;
        k[n] = tensor ? PERI_FN(constant)(s, PERI__STABILIZATION, ends[n]) : 0;
        for (int p = 0; p < PERI_D * PERI_D; ++p) q[n][p] = tensor ? PERI_FN(response)(s, 1 + p, ends[n]) : 0;
    }
    for (int a = 0; a < PERI_D; ++a) {
        const peri_b *own = q[0] + a * PERI_D, *other = q[1] + a * PERI_D;
        peri_b sum = listed ? (weights[0] * k[0] + weights[1] * k[1]) * bond->eta[a] : (k[0] + k[1]) * bond->eta[a];
        for (int d = 0; d < PERI_D; ++d)
            sum += listed ? (weights[0] * own[d] + weights[1] * other[d]) * bond->xi[d] : (own[d] + other[d]) * bond->xi[d];
        t[a] += listed ? sum : weights[0] * sum;
    }
}

/* The force of a bond along y over |y| as list.inl takes it, pairwise or ordinary. */
static peri_b PERI_FN(listed_pull)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    const peri__model *m = s->model;
    const int64_t j = row->ids[k];
    const int by_length = !m->pairwise && m->gauge;
    const peri_b weight = ((const peri_b *)row->weight)[k], back = ((const peri_b *)row->back)[k];
    peri_b rest = 0, now = 0, scale;
    for (int d = 0; d < PERI_D; ++d) {
        rest += bond->xi[d] * bond->xi[d];
        now += bond->y[d] * bond->y[d];
    }
    const peri_b length = by_length ? rest : PERI_SQRT(rest);
    const peri_b product = s->linear ? rest : by_length ? PERI_SQRT(rest * now) : length * PERI_SQRT(now);
    const peri_b reach = s->linear ? rest : product + rest;
    if (m->pairwise) scale = (peri_b)PERI_FN(pair)(s, i, j)->c * weight * bond->along * length;
    else {
        const peri_b p = weight * PERI_FN(response)(s, 0, i) + back * PERI_FN(response)(s, 0, j);
        const peri_b q = weight * PERI_FN(constant)(s, PERI__SPRING, i) + back * PERI_FN(constant)(s, PERI__SPRING, j);
        scale = q * bond->along;
        if (!by_length) scale = scale * length;
        scale = length * (scale + p * reach);
    }
    return scale / (reach * (product + PERI_TINY));
}
#endif

/* Does list_mixed serve the body? */
PERI_INLINE int PERI_FN(is_list_mixed)(const peri__model *m) {
    return m->record_reals > 0 && !(m->gathers & PERI__GRADIENT) && (m->mixed || m->seen_by & PERI__BY_WORK);
}

/* Both halves of a bond of laws that differ: adds the tensor parts to t and returns the force along y over |y|. */
static peri_b PERI_FN(mixed_pull)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond,
                                  peri_b *t) {
    const peri__model *m = s->model;
    const int64_t ends[2] = { i, row->ids[k] };
    const peri_b weights[2] = { ((const peri_b *)row->weight)[k], ((const peri_b *)row->back)[k] };
    peri_b p[2] = { 0, 0 }, q[2], along[2], pull; /* rounded before they are added: both ends must come to the same sum on the x87, too */
    for (int n = 0; n < 2; ++n) {
        const peri__law *law = &m->laws[m->material[ends[n]]];
        along[n] = bond->along;
        if (law->pairwise) {
            q[n] = (peri_b)(0.5 * PERI_FN(pair)(s, ends[n], ends[1 - n])->c) / bond->length;
            if (s->stiffness) q[n] *= PERI_FN(stiffness_between)(s, i, row->ids[k]);
        } else {
            const peri_b shift = PERI_FN(mean_eigenstrain)(s, i, row->ids[k]) - PERI_FN(eigenstrain)(s, ends[n]);
            if (s->eigenstrain) along[n] += shift * (bond->length * bond->reach); /* the half of a point feels its own */
            q[n] = PERI_FN(constant)(s, PERI__SPRING, ends[n]);
            p[n] = PERI_FN(response)(s, 0, ends[n]) * PERI_FN(gauge)(law, bond->length);
        }
    }
    if (s->fields) {
        const peri_b own = q[0] * along[0] + p[0] * bond->reach, other = q[1] * along[1] + p[1] * bond->reach;
        pull = m->back == m->weight ? weights[0] * (own + other) : weights[0] * own + weights[1] * other;
    } else if (m->back == m->weight && !PERI_FN(is_list_mixed)(m))
        pull = weights[0] * ((q[0] + q[1]) * bond->along + (p[0] + p[1]) * bond->reach);
    else
        pull = (weights[0] * q[0] + weights[1] * q[1]) * bond->along + (weights[0] * p[0] + weights[1] * p[1]) * bond->reach;
    if (m->gathers & PERI__GRADIENT) PERI_FN(tensor_pull)(s, ends, weights, bond, t);
    return pull / (bond->reach * (bond->now + PERI_TINY));
}

/* The same of one ordinary law. */
PERI_INLINE peri_b PERI_FN(ordinary_pull)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond,
                                          const int linear) {
    const peri__model *m = s->model;
    const int64_t j = row->ids[k];
    const peri_b qi = PERI_FN(constant)(s, PERI__SPRING, i), qj = PERI_FN(constant)(s, PERI__SPRING, j);
    const peri_b pi = PERI_FN(response)(s, 0, i), pj = PERI_FN(response)(s, 0, j);
    const peri_b gauge = m->gauge ? bond->length : 1;
    peri_b weight = ((const peri_b *)row->weight)[k], back = ((const peri_b *)row->back)[k], pull;
    if (linear) { /* over |xi|^2 here */
        const peri_b inverse = 1 / bond->length;
        weight *= inverse * inverse;
        back *= inverse * inverse;
    }
    if (m->back == m->weight) pull = weight * ((qi + qj) * bond->along + (pi + pj) * gauge * bond->reach);
    else pull = (weight * qi + back * qj) * bond->along + (weight * pi + back * pj) * gauge * bond->reach;
    return linear ? pull : pull / (bond->reach * (bond->now + PERI_TINY));
}

/* The same of pairwise laws: c w s M. */
PERI_INLINE peri_b PERI_FN(pairwise_pull)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond,
                                          const int linear) {
    const peri_b c = (peri_b)PERI_FN(pair)(s, i, row->ids[k])->c, weight = ((const peri_b *)row->weight)[k];
    if (linear) {
        const peri_b inverse = 1 / bond->length;
        return c * weight * (inverse * inverse * inverse) * bond->along;
    }
    return c * weight * bond->along / (bond->reach * bond->length * (bond->now + PERI_TINY));
}

/* The work of the force t, times portion, along the way of bond k since it was last worked out, by the trapezoidal rule. */
static void PERI_FN(count_work)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const peri_b *eta, const peri_r *t,
                                peri_r portion) {
    const peri__model *m = s->model;
    const int64_t j = row->ids[k], at = peri__bond_slot(m, i, row, k);
    const peri_r *worked = (const peri_r *)s->worked;
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *w = worked + d * m->stride;
        peri_r *pull = (peri_r *)s->pull + peri__pull_slot(m, at, d);
        const peri_r now = portion * t[d];
        ((peri_r *)s->work)[at] += (peri_r)0.5 * (*pull + now) * (eta[d] - (w[j] - w[i]));
        *pull = now;
    }
}

/* What list_mixed asks of the ends of bonds of a material, by the material of the other: c/2 of the own end and of the other, 0 where that
   law is not pairwise; 1 where the gauge of the other is |xi|. */
static PERI_APART void PERI_FN(tell_ends)(const peri__model *m, int32_t material, peri_b table[3][PERI_MATERIAL_LIMIT]) {
    for (int32_t k = 0; k < m->materials; ++k) {
        table[0][k] = (peri_b)(m->laws[material].pairwise ? 0.5 * m->pairs[material * m->materials + k].c : 0.0);
        table[1][k] = (peri_b)(m->laws[k].pairwise ? 0.5 * m->pairs[k * m->materials + material].c : 0.0);
        table[2][k] = m->laws[k].gauge ? (peri_b)1 : (peri_b)0;
    }
}

/* The work of the forces of live bonds of the list, those of row i from bond k on; force, eta: of PERI_CHUNK bonds. Returns 1 where the
   work on one comes near its limit. */
static int PERI_FN(count_chunk)(const peri__operands *s, int64_t i, int64_t k, uint32_t flags, peri_b force[PERI_D][PERI_CHUNK],
                                peri_b eta[PERI_D][PERI_CHUNK]) {
    PERI_NO_CONTRACTION
    const peri__model *m = s->model;
    const peri_r portion = PERI_FN(portion)(m, i), *worked = (const peri_r *)s->worked;
    const double most = s->breaking ? peri__least_limit(s, i, PERI_CRITERION_BOND_ENERGY) * peri__square(s->least_strength) : PERI_NEVER;
    int hit = 0;
    for (int64_t l = 0, at = m->start[i] + k; flags >> l; ++l, ++at) {
        const int64_t j = peri__nth(m, m->ids[at]);
        peri_r *work = (peri_r *)s->work + at, *pull = (peri_r *)s->pull + at * PERI_D;
        if (!(flags >> l & 1)) continue;
        for (int d = 0; d < PERI_D; ++d) {
            const peri_r *w = worked + d * m->stride, now = portion * force[d][l];
            *work += (peri_r)0.5 * (pull[d] + now) * (eta[d][l] - (w[j] - w[i]));
            pull[d] = now;
        }
        hit |= (double)*work > most * (1.0 - PERI_NEAR) * (m->partial_volume ? (double)m->partial_volume[at] : m->volume[j]);
    }
    return hit;
}

/* Adds the force of the live bonds of row i to f. Bonds that meet their criterion break: with pairwise laws at once, what they still give
   going to `impulse` and the energy that they break with to *lost (per volume of the body); else they are noted in `dying`, and still act.
   Returns their number. `pairwise`, `mixed` and `plain` (neither linear nor centred, only critical stretches) are constants where this is
   inlined. */
PERI_INLINE int32_t PERI_FN(row_force)(const peri__operands *s, int64_t i, const peri__row *row, peri_r *f, peri_r *impulse, double *lost,
                                       const int pairwise, const int mixed, const int plain) {
    const peri__model *m = s->model;
    const int breaking = s->breaking && s->alive;
    const int32_t count = (int32_t)row->count;
    const peri_r portion = PERI_FN(portion)(m, i);
    int32_t over = 0;
    peri_r sum[PERI_D];
    for (int d = 0; d < PERI_D; ++d) sum[d] = PERI_MUTUAL(m) ? 0 : f[d];
    for (int32_t first = 0; first < count; first += 32) {
        const uint32_t live = s->alive ? s->alive[i * m->words + first / 32] : ~(uint32_t)0;
        const int32_t chunk = count - first < 32 ? count - first : 32;
        uint32_t dead = 0;
        for (int32_t n = 0; n < chunk; ++n) {
            const int64_t k = first + n;
            PERI_FN(bond) bond;
            peri_b t[PERI_D] = { 0 }, pull;
            peri_r force[PERI_D];
            if (!(live >> n & 1)) continue;
            if (plain) PERI_FN(deform_as)(s, i, row, k, &bond, 0, 0);
            else PERI_FN(deform)(s, i, row, k, &bond);
#if PERI_T_BOND == 32
            if (!mixed && m->record_reals && (plain || !s->fields)) pull = PERI_FN(listed_pull)(s, i, row, k, &bond);
            else
#endif
            if (pairwise && (plain || !s->fields)) pull = PERI_FN(pairwise_pull)(s, i, row, k, &bond, plain ? 0 : s->linear);
            else if (pairwise || mixed) pull = PERI_FN(mixed_pull)(s, i, row, k, &bond, t);
            else pull = PERI_FN(ordinary_pull)(s, i, row, k, &bond, plain ? 0 : s->linear);
            for (int d = 0; d < PERI_D; ++d) force[d] = mixed ? t[d] + pull * bond.y[d] : pull * bond.y[d];
            if (!pairwise && !plain && s->working) PERI_FN(count_work)(s, i, row, k, bond.eta, force, portion);
            if (breaking && (plain ? PERI_FN(is_overstretched)(s, i, row, k, &bond) : PERI_FN(is_over)(s, i, row, k, &bond))) {
                dead |= (uint32_t)1 << n;
                over++;
                if (pairwise) {
                    const double c = PERI_FN(pair)(s, i, row->ids[k])->c * (double)PERI_FN(stiffness_between)(s, i, row->ids[k]);
                    const double weight = (double)((const peri_b *)row->weight)[k];
                    const PERI_FN(bond) parted = bond; /* a copy, so that the others stay in registers */
                    const peri__parting parting = PERI_FN(part)(s, i, row, k, &parted);
                    const double stretch = parting.met * (double)bond.along / ((double)bond.reach * (double)bond.length);
                    *lost += 0.25 * (double)(peri_b)c * weight * stretch * stretch * (double)bond.length
                           * (m->volume[i] * (double)portion);
                    for (int d = 0; d < PERI_D; ++d) impulse[d] += (peri_r)(0.5 * s->step * parting.share * (double)force[d]);
                    continue;
                }
            }
            for (int d = 0; d < PERI_D; ++d) sum[d] += force[d];
        }
        if (pairwise && dead) s->alive[i * m->words + first / 32] = live & ~dead;
        if (!pairwise && breaking) s->dying[i * m->words + first / 32] = dead;
    }
    for (int d = 0; d < PERI_D; ++d) f[d] = PERI_MUTUAL(m) ? f[d] + portion * sum[d] : sum[d];
    for (int d = 0; pairwise && d < PERI_D; ++d) impulse[d] *= portion;
    return over;
}

/* The force density that bond k of row i adds to its point, by itself. */
static void PERI_FN(bond_force)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, double *force) {
    PERI_FN(bond) bond;
    peri_b t[PERI_D] = { 0 };
    PERI_FN(deform)(s, i, row, k, &bond);
    const peri_b pull = PERI_FN(mixed_pull)(s, i, row, k, &bond, t);
    for (int d = 0; d < PERI_D; ++d) force[d] = (double)((peri_r)(t[d] + pull * bond.y[d]) * PERI_FN(portion)(s->model, i));
}

/* The force density of the bonds of point i is added to f. sums: a energy of bonds that broke, n the (directed) number of those that broke
   or are to; a without, b the number of pairwise bonds of ghosts. */
static void PERI_FN(point_force)(const peri__operands *s, int64_t i, peri_r *f, peri__sums *sums) {
    const peri__model *m = s->model;
    peri_r impulse[PERI_D] = { 0 };
    peri__row row;
    peri__row_of(m, i, &row);
    const int plain = !s->linear && !m->centroid && !m->seen_by && !s->fields;
    if (!m->pairwise) {
        const int mixed = s->fields || m->mixed || m->gathers & PERI__GRADIENT || PERI_FN(is_list_mixed)(m)
                        || (PERI_T_BOND == 32 && m->stencil.ends);
        if (mixed) sums->n += PERI_FN(row_force)(s, i, &row, f, NULL, NULL, 0, 1, 0);
        else if (plain) sums->n += PERI_FN(row_force)(s, i, &row, f, NULL, NULL, 0, 0, 1);
        else sums->n += PERI_FN(row_force)(s, i, &row, f, NULL, NULL, 0, 0, 0);
        return;
    }
    const double lost = sums->a;
    const int32_t broke = plain ? PERI_FN(row_force)(s, i, &row, f, impulse, &sums->a, 1, 0, 1)
                                : PERI_FN(row_force)(s, i, &row, f, impulse, &sums->a, 1, 0, 0);
    if (s->ghost && s->ghost[i]) {
        sums->a = lost;
        sums->b += broke;
    }
    for (int d = 0; broke && s->closing && d < PERI_D; ++d) ((peri_r *)s->closing)[d * m->stride + i] = impulse[d];
    sums->n += broke;
}

/* Points [begin, end), one by one. */
static void PERI_FN(force_rows)(const peri__operands *s, int64_t begin, int64_t end, peri__sums *sums) {
    const int64_t stride = s->model->stride;
    peri_r *force = (peri_r *)s->f;
    for (int64_t i = begin; i < end; ++i) {
        peri_r f[PERI_D];
        for (int d = 0; d < PERI_D; ++d) f[d] = force[d * stride + i];
        PERI_FN(point_force)(s, i, f, sums);
        for (int d = 0; d < PERI_D; ++d) force[d * stride + i] = f[d];
    }
}

/* For the points of a list: takes the force that their bonds give out of f (sign -1), or puts it in (1), and adds the opposite of it for
   some time to `closing`. */
static void PERI_FN(add_point_forces)(const peri__operands *s, const int32_t *points, int64_t count, int sign, double time) {
    const peri__model *m = s->model;
    for (int64_t k = 0; k < count; ++k) {
        const int64_t i = points[k];
        peri_r f[PERI_D] = { 0 };
        peri__sums sums = { 0.0, 0.0, 0, -1 };
        PERI_FN(point_force)(s, i, f, &sums);
        for (int d = 0; d < PERI_D; ++d) {
            ((peri_r *)s->f)[d * m->stride + i] += (peri_r)sign * f[d];
            if (s->closing) ((peri_r *)s->closing)[d * m->stride + i] -= (peri_r)(sign * time) * f[d];
        }
    }
}

/* ---- gathering ------------------------------------------------------------------------------------------------------ */

/* sum w g e V. */
static peri_r PERI_FN(row_dilatation_sum)(const peri__operands *s, int64_t i, const peri__row *row) {
    const int by_length = s->model->laws[s->model->material[i]].gauge;
    peri_r sum = 0;
    for (int64_t k = 0; k < row->count; ++k) {
        const peri_b length = ((const peri_b *)row->bond)[k], weight = ((const peri_b *)row->weight)[k];
        const peri_b gauge = s->linear ? (by_length ? 1 : 1 / length) : by_length ? length : 1, gauged = weight * gauge;
        PERI_FN(bond) bond;
        if (!PERI_FN(is_live)(s, i, k)) continue;
        PERI_FN(deform_whole)(s, i, row, k, &bond);
        sum += s->linear ? gauged * bond.along : gauged * (bond.along / bond.reach);
    }
    return sum * PERI_FN(portion)(s->model, i);
}

PERI_INLINE void PERI_FN(share_out)(const peri__model *m, int64_t i, peri_r n[PERI_D][PERI_D]) {
    const peri_r portion = PERI_FN(portion)(m, i);
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) n[a][d] *= portion;
}

/* sum w eta xi V. */
static void PERI_FN(row_shape)(const peri__operands *s, int64_t i, const peri__row *row, peri_r n[PERI_D][PERI_D]) {
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) n[a][d] = 0;
    for (int64_t k = 0; k < row->count; ++k) {
        const peri_b weight = ((const peri_b *)row->weight)[k];
        peri_b xi[PERI_D], eta[PERI_D];
        if (!PERI_FN(is_live)(s, i, k)) continue;
        PERI_FN(bond_vectors)(s, i, row, k, xi, eta, 0);
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) n[a][d] += weight * eta[a] * xi[d];
    }
    PERI_FN(share_out)(s->model, i, n);
}

/* The least stretch of the live bonds of point i; HUGE_VAL where there are none. */
static double PERI_FN(row_least)(const peri__operands *s, int64_t i) {
    peri__row row;
    double least = HUGE_VAL;
    peri__row_of(s->model, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        PERI_FN(bond) bond;
        if (!PERI_FN(is_live)(s, i, k)) continue;
        PERI_FN(deform)(s, i, &row, k, &bond);
        const double stretch = (double)bond.along / ((double)bond.reach * (double)bond.length);
        if (stretch < least) least = stretch;
    }
    return least;
}

PERI_INLINE peri_b PERI_FN(inverse)(const peri__operands *s, int64_t i, int c, int d) {
    return PERI_FN(constant)(s, PERI__SHAPE_INVERSE + peri__packed(PERI_D, c, d), i);
}

/* H = (sum w eta xi V) K^-1. */
static void PERI_FN(gradient)(const peri__operands *s, int64_t i, peri_r n[PERI_D][PERI_D], peri_r h[PERI_D][PERI_D]) {
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) {
            h[a][d] = 0;
            for (int c = 0; c < PERI_D; ++c) h[a][d] += n[a][c] * PERI_FN(inverse)(s, i, c, d);
        }
}

/* theta where all bonds of point i have the stretch of its eigenstrain: D times that, less what bonds that are gone do not add where the
   constants count them. */
static peri_r PERI_FN(eigen_dilatation)(const peri__operands *s, int64_t i) {
    const peri_r eigenstrain = PERI_FN(eigenstrain)(s, i);
    peri_r sum = 0;
    peri__row row;
    if (!s->partly) return PERI_D * eigenstrain;
    peri__row_of(s->model, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        const peri_b length = ((const peri_b *)row.bond)[k];
        if (PERI_FN(is_live)(s, i, k))
            sum += ((const peri_b *)row.weight)[k] * PERI_FN(gauge)(&s->model->laws[s->model->material[i]], length) * length;
    }
    return PERI_FN(constant)(s, PERI__THETA_FACTOR, i) * (eigenstrain * sum * PERI_FN(portion)(s->model, i));
}

/* p of the sum w g e V. The product of the two constants alone can leave the range of float. */
PERI_INLINE void PERI_FN(put_pressure)(const peri__operands *s, int64_t i, peri_r sum) {
    const peri_b pressure_factor = PERI_FN(constant)(s, PERI__PRESSURE_FACTOR, i);
    peri_r theta = PERI_FN(constant)(s, PERI__THETA_FACTOR, i) * sum;
    if (s->eigenstrain && pressure_factor != 0) theta -= PERI_FN(eigen_dilatation)(s, i);
    ((peri_b *)s->response)[i] = pressure_factor == 0 ? 0 : (peri_b)(pressure_factor * theta);
}

/* Takes the eigenstrain out of the strain e of point i. Of large motion it is that of F = 1 + eigenstrain, so that a point that has
   grown by it and turned bears nothing. Where there is no K^-1 no bond has a part in H, so that nothing is borne either. */
static void PERI_FN(make_elastic)(const peri__operands *s, int64_t i, peri_r e[PERI_D][PERI_D]) {
    const peri_r own = PERI_FN(eigenstrain)(s, i), grown = s->linear ? own : own + (peri_r)0.5 * own * own;
    for (int a = 0; PERI_FN(inverse)(s, i, 0, 0) != 0 && a < PERI_D; ++a) e[a][a] -= grown;
}

/* H of a point whose stress is not the library's goes where Q is. */
static void PERI_FN(put_raw)(const peri__operands *s, int64_t i, void *to, peri_r h[PERI_D][PERI_D]) {
    peri_b *response = (peri_b *)to + i;
    response[0] = 0;
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) response[(1 + a * PERI_D + d) * s->model->stride] = (peri_b)h[a][d];
}

/* Q = P K^-1 - k H of n = sum w eta xi V. */
static void PERI_FN(put_tensor)(const peri__operands *s, int64_t i, peri_r n[PERI_D][PERI_D]) {
    const peri__model *m = s->model;
    peri__law room;
    const peri__law *law = peri__stiffened(m, i, (double)PERI_FN(stiffness)(s, i), &room);
    peri_b *response = (peri_b *)s->response + i;
    peri_r h[PERI_D][PERI_D], e[PERI_D][PERI_D], p[PERI_D][PERI_D];
    PERI_FN(gradient)(s, i, n, h);
    if (s->past.raw && s->past.raw[m->material[i]]) {
        PERI_FN(put_raw)(s, i, s->response, h);
        return;
    }
    PERI_FN(strain)(PERI_D, s->linear, h, e);
    if (s->eigenstrain) PERI_FN(make_elastic)(s, i, e);
    PERI_FN(stress)(law, PERI_D, s->linear, h, e, p);
    response[0] = 0;
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) {
            peri_r q = -PERI_FN(constant)(s, PERI__STABILIZATION, i) * h[a][d];
            for (int c = 0; c < PERI_D; ++c) q += p[a][c] * PERI_FN(inverse)(s, i, c, d);
            response[(1 + a * PERI_D + d) * m->stride] = (peri_b)q;
        }
}

/* ---- energy --------------------------------------------------------------------------------------------------------- */

/* Energy density of point i: half of that of its bonds, w q e^2/2 each, and what it gathers. */
static double PERI_FN(point_energy)(const peri__operands *s, int64_t i, const peri__row *row) {
    const peri__model *m = s->model;
    peri__law room;
    const peri__law *law = peri__stiffened(m, i, (double)PERI_FN(stiffness)(s, i), &room);
    double density = 0.0, squares = 0.0, apart = 0.0;
    peri_r sum = 0;
    for (int64_t k = 0; k < row->count; ++k) {
        const peri_b weight = ((const peri_b *)row->weight)[k];
        PERI_FN(bond) bond;
        if (!PERI_FN(is_live)(s, i, k)) continue;
        PERI_FN(deform_whole)(s, i, row, k, &bond);
        peri_b e = bond.along / bond.reach, c = 1;
        if (s->eigenstrain)
            e -= bond.length * (law->pairwise ? PERI_FN(mean_eigenstrain)(s, i, row->ids[k]) : PERI_FN(eigenstrain)(s, i));
        if (s->stiffness) c = PERI_FN(stiffness_between)(s, i, row->ids[k]);
        if (law->pairwise)
            density += 0.25 * PERI_FN(pair)(s, i, row->ids[k])->c * (double)c * (double)weight * (double)e * (double)e
                     / (double)bond.length;
        sum += weight * PERI_FN(gauge)(law, bond.length) * e;
        squares += (double)weight * (double)e * (double)e;
    }
    const double share = peri__share(m, i);
    density /= share;
    squares /= share;
    if (law->pairwise) return density;
    const double theta_factor = (double)PERI_FN(constant)(s, PERI__THETA_FACTOR, i), dilatation_sum = (double)sum / share;
    density = 0.5 * (double)PERI_FN(constant)(s, PERI__SPRING, i) * squares;
    if (!(law->gather & PERI__GRADIENT))
        return density + 0.5 * (double)PERI_FN(constant)(s, PERI__PRESSURE_FACTOR, i) * theta_factor * dilatation_sum * dilatation_sum;

    peri_r n[PERI_D][PERI_D], h[PERI_D][PERI_D], strain[PERI_D][PERI_D];
    PERI_FN(row_shape)(s, i, row, n);
    PERI_FN(gradient)(s, i, n, h);
    PERI_FN(strain)(PERI_D, s->linear, h, strain);
    if (s->eigenstrain) PERI_FN(make_elastic)(s, i, strain);
    for (int64_t k = 0; k < row->count; ++k) { /* sum w |eta - H xi|^2 V */
        peri_b xi[PERI_D], eta[PERI_D];
        if (!PERI_FN(is_live)(s, i, k)) continue;
        PERI_FN(bond_vectors)(s, i, row, k, xi, eta, 0);
        for (int a = 0; a < PERI_D; ++a) {
            peri_r z = eta[a];
            for (int d = 0; d < PERI_D; ++d) z -= h[a][d] * xi[d];
            apart += (double)((const peri_b *)row->weight)[k] * peri__square((double)z);
        }
    }
    apart /= share;
    return density + PERI_FN(strain_energy)(law, PERI_D, strain) + 0.5 * (double)PERI_FN(constant)(s, PERI__STABILIZATION, i) * apart;
}

/* What points make of their families: p, Q, and where a criterion asks for it the energy of the node. */
static void PERI_FN(gather_rows)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *s = (const peri__operands *)context;
    const peri__model *m = s->model;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        const peri__law *law = &m->laws[m->material[i]];
        peri_r n[PERI_D][PERI_D];
        peri__row_of(m, i, &row);
        if (law->gather & PERI__GRADIENT) {
            PERI_FN(row_shape)(s, i, &row, n);
            PERI_FN(put_tensor)(s, i, n);
        } else if (!law->pairwise)
            PERI_FN(put_pressure)(s, i, law->gather & PERI__DILATATION ? PERI_FN(row_dilatation_sum)(s, i, &row) : 0);
        if (s->node) s->node[i] = 2.0 * PERI_FN(point_energy)(s, i, &row) / peri__family_volume(m, i);
    }
}
