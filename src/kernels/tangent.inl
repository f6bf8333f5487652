/* SPDX-License-Identifier: MIT */
/* tangent.inl - the tangent of the force where the geometry is not linear, by rows.

   With the halves T = w [(p g + q e) M + Q xi + k eta] of both ends a change d of the displacements changes the force on i by
       sum_j [dc M + c/|y| (d eta - M de)] + w (dQ xi + k d eta),    de = M.d eta,    dc = w (dp g + q de),
   c the sum of both w (p g + q e). dp and dQ are what the change makes of theta and F, in the first pass. */

typedef struct PERI_FN(change) { /* bond k of row i and the change d eta of its ends, in reals of the state               */
    peri_r xi[PERI_D], eta[PERI_D], delta[PERI_D], y[PERI_D]; /* y: the unit vector M                                    */
    peri_r bond, length, e, de;                               /* |xi|, |y|, e, M.d eta                                   */
} PERI_FN(change);

static void PERI_FN(change_bond)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, PERI_FN(change) *c) {
    const peri__model *m = s->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)s->u, *p = (const peri_r *)s->p;
    const int64_t j = row->ids[k];
    peri_r along = 0, square = 0;
    c->bond = ((const peri_b *)row->bond)[k];
    for (int d = 0; d < PERI_D; ++d) {
        const int64_t own = d * m->stride + i, other = d * m->stride + j;
        c->xi[d] = x[other] - x[own];
        c->eta[d] = u[other] - u[own];
        c->delta[d] = p[other] - p[own];
        c->y[d] = c->xi[d] + c->eta[d];
        along += (2 * c->xi[d] + c->eta[d]) * c->eta[d];
        square += c->y[d] * c->y[d];
    }
    c->length = PERI_ROOT(square) + (peri_r)PERI_TINY;
    c->e = along / (c->length + c->bond);
    c->de = 0;
    for (int d = 0; d < PERI_D; ++d) {
        c->y[d] /= c->length;
        c->de += c->y[d] * c->delta[d];
    }
}

/* dp of an ordinary point. */
static void PERI_FN(change_pressure)(const peri__operands *s, int64_t i, const peri__row *row) {
    const int by_length = s->model->laws[s->model->material[i]].gauge;
    peri_r sum = 0;
    for (int64_t k = 0; k < row->count; ++k) {
        PERI_FN(change) c;
        if (!PERI_FN(is_live)(s, i, k)) continue;
        PERI_FN(change_bond)(s, i, row, k, &c);
        sum += (peri_r)((const peri_b *)row->weight)[k] * (by_length ? c.bond : 1) * c.de;
    }
    sum *= PERI_FN(portion)(s->model, i);
    ((peri_b *)s->change)[i] =
        (peri_b)(PERI_FN(constant)(s, PERI__PRESSURE_FACTOR, i) * (PERI_FN(constant)(s, PERI__THETA_FACTOR, i) * sum));
}

/* dQ of a point with a gradient. */
static void PERI_FN(change_tensor)(const peri__operands *s, int64_t i, const peri__row *row) {
    const peri__model *m = s->model;
    peri__law room;
    const peri__law *law = peri__stiffened(m, i, (double)PERI_FN(stiffness)(s, i), &room);
    peri_b *change = (peri_b *)s->change + i;
    peri_r n[PERI_D][PERI_D] = { { 0 } }, dn[PERI_D][PERI_D] = { { 0 } };
    peri_r h[PERI_D][PERI_D], dh[PERI_D][PERI_D], e[PERI_D][PERI_D], dp[PERI_D][PERI_D];
    for (int64_t k = 0; k < row->count; ++k) {
        const peri_r weight = ((const peri_b *)row->weight)[k];
        PERI_FN(change) c;
        if (!PERI_FN(is_live)(s, i, k)) continue;
        PERI_FN(change_bond)(s, i, row, k, &c);
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) {
                n[a][d] += weight * c.eta[a] * c.xi[d];
                dn[a][d] += weight * c.delta[a] * c.xi[d];
            }
    }
    PERI_FN(share_out)(m, i, n);
    PERI_FN(share_out)(m, i, dn);
    PERI_FN(gradient)(s, i, n, h);
    PERI_FN(gradient)(s, i, dn, dh);
    if (s->past.raw && s->past.raw[m->material[i]]) {
        PERI_FN(put_raw)(s, i, s->change, dh);
        return;
    }
    PERI_FN(strain)(PERI_D, 0, h, e);
    if (s->eigenstrain) PERI_FN(make_elastic)(s, i, e);
    PERI_FN(stress_change)(law, PERI_D, 0, h, e, dh, dp);
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) {
            peri_r q = -PERI_FN(constant)(s, PERI__STABILIZATION, i) * dh[a][d];
            for (int c = 0; c < PERI_D; ++c) q += dp[a][c] * PERI_FN(inverse)(s, i, c, d);
            change[(1 + a * PERI_D + d) * m->stride] = (peri_b)q;
        }
}

/* dp, or dQ, of points [begin, end): from ->p to ->change. */
static void PERI_FN(tangent_gather)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *s = (const peri__operands *)context;
    const peri__model *m = s->model;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        const peri__law *law = &m->laws[m->material[i]];
        ((peri_b *)s->change)[i] = 0;
        if (!law->gather || (law->gather == PERI__DILATATION && PERI_FN(constant)(s, PERI__PRESSURE_FACTOR, i) == 0)) continue;
        peri__row_of(m, i, &row);
        if (law->gather & PERI__GRADIENT) PERI_FN(change_tensor)(s, i, &row);
        else PERI_FN(change_pressure)(s, i, &row);
    }
}

/* The half of end i: adds w (p g + q e) to c, its change to dc, and what gradients add to t. */
PERI_INLINE void PERI_FN(tangent_half)(const peri__operands *s, int64_t i, int64_t j, peri_r weight, const PERI_FN(change) *b, peri_r *c,
                                       peri_r *dc, peri_r *t) {
    const peri__model *m = s->model;
    const peri__law *law = &m->laws[m->material[i]];
    if (law->pairwise) {
        const peri_r spring = weight * (peri_r)(0.5 * PERI_FN(pair)(s, i, j)->c) * PERI_FN(stiffness_between)(s, i, j) / b->bond;
        *c += spring * (b->e - b->bond * PERI_FN(mean_eigenstrain)(s, i, j));
        *dc += spring * b->de;
        return;
    }
    const peri_b *change = (const peri_b *)s->change + i; /* pairwise bodies have none */
    const peri_r gauge = law->gauge ? b->bond : 1, spring = PERI_FN(constant)(s, PERI__SPRING, i);
    *c += weight * (PERI_FN(response)(s, 0, i) * gauge + spring * (b->e - b->bond * PERI_FN(eigenstrain)(s, i)));
    *dc += weight * (change[0] * gauge + spring * b->de);
    if (!(law->gather & PERI__GRADIENT)) return;
    for (int a = 0; a < PERI_D; ++a) {
        peri_r sum = PERI_FN(constant)(s, PERI__STABILIZATION, i) * b->delta[a];
        for (int d = 0; d < PERI_D; ++d) sum += change[(1 + a * PERI_D + d) * m->stride] * b->xi[d];
        t[a] += weight * sum;
    }
}

/* The change of the force density of points [begin, end): to ->q. */
static void PERI_FN(tangent_force)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *s = (const peri__operands *)context;
    const peri__model *m = s->model;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        peri_r sum[PERI_D] = { 0 };
        peri__row_of(m, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int64_t j = row.ids[k];
            peri_r t[PERI_D] = { 0 }, c = 0, dc = 0;
            PERI_FN(change) b;
            if (!PERI_FN(is_live)(s, i, k)) continue;
            PERI_FN(change_bond)(s, i, &row, k, &b);
            PERI_FN(tangent_half)(s, i, j, ((const peri_b *)row.weight)[k], &b, &c, &dc, t);
            PERI_FN(tangent_half)(s, j, i, ((const peri_b *)row.back)[k], &b, &c, &dc, t);
            for (int d = 0; d < PERI_D; ++d) sum[d] += t[d] + dc * b.y[d] + c / b.length * (b.delta[d] - b.y[d] * b.de);
        }
        for (int d = 0; d < PERI_D; ++d) ((peri_r *)s->q)[d * m->stride + i] = sum[d] * PERI_FN(portion)(m, i);
    }
}
