/* k_solve.inl - the static solver's work on whole vectors, and the tangent of the force where the geometry is not linear.

   With the halves T = w [(p g + q e) M + Q xi + k eta] of both ends a change d of the displacements changes the force on i by
       sum_j [dc M + c/|y| (d eta - M de)] + w (dQ xi + k d eta),    de = M.d eta,    dc = w (dp g + q de),
   c the sum of both w (p g + q e). dp and dQ are what the change makes of theta and F, in the first pass. */

/* dp, or dQ, of points [begin, end): from ->p to ->change, laid out as body->response. */
static void PERI_FN(tangent_respond)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__tangent *t = (const peri__tangent *)context;
    const peri_body *b = t->body;
    const peri__model *m = b->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)b->u, *p = (const peri_r *)t->p;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        const peri__law *law = &m->laws[m->material[i]];
        const peri_b *constant = (const peri_b *)b->constant + m->margin + i;
        peri_b *change = (peri_b *)t->change + m->margin + i;
        peri_r n[PERI_D][PERI_D] = { { 0 } }, dn[PERI_D][PERI_D] = { { 0 } }, sum = 0;
        const int tensor = law->model == PERI_CORRESPONDENCE;
        peri__row row;
        change[0] = 0;
        if (law->model == PERI_BOND_BASED || (!tensor && constant[PERI__PRESS * m->stride] == 0)) continue;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int64_t j = row.ids[k];
            const peri_r bond = ((const peri_b *)row.bond)[k], weight = ((const peri_b *)row.weight)[k];
            peri_r xi[PERI_D], eta[PERI_D], delta[PERI_D], along = 0, square = 0;
            if (b->alive && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
            for (int d = 0; d < PERI_D; ++d) {
                xi[d] = x[d * m->stride + j] - x[d * m->stride + i];
                eta[d] = u[d * m->stride + j] - u[d * m->stride + i];
                delta[d] = p[d * m->stride + j] - p[d * m->stride + i];
                along += (xi[d] + eta[d]) * delta[d];
                square += (xi[d] + eta[d]) * (xi[d] + eta[d]);
            }
            if (!tensor) sum += weight * (law->model == PERI_OTERKUS ? 1 : bond) * along / (PERI_ROOT(square) + (peri_r)PERI_TINY);
            for (int a = 0; tensor && a < PERI_D; ++a)
                for (int d = 0; d < PERI_D; ++d) {
                    n[a][d] += weight * eta[a] * xi[d];
                    dn[a][d] += weight * delta[a] * xi[d];
                }
        }
        if (!tensor) {
            change[0] = (peri_b)(constant[PERI__PRESS * m->stride] * (constant[PERI__DILATE * m->stride] * sum));
            continue;
        }
        peri_r h[PERI_D][PERI_D], dh[PERI_D][PERI_D], s[PERI_D][PERI_D], ds[PERI_D][PERI_D], dp[PERI_D][PERI_D], trace = 0, dtrace = 0;
        PERI_FN(gradient)(b, i, n, h);
        PERI_FN(gradient)(b, i, dn, dh);
        PERI_FN(strain)(0, h, s);
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) {
                ds[a][d] = (peri_r)0.5 * (dh[a][d] + dh[d][a]);
                for (int c = 0; c < PERI_D; ++c) ds[a][d] += (peri_r)0.5 * (dh[c][a] * h[c][d] + h[c][a] * dh[c][d]);
            }
        for (int a = 0; a < PERI_D; ++a) {
            trace += s[a][a];
            dtrace += ds[a][a];
        }
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) {
                s[a][d] = (peri_r)(2.0 * law->mu) * s[a][d] + (a == d ? (peri_r)law->lambda * trace : 0);
                ds[a][d] = (peri_r)(2.0 * law->mu) * ds[a][d] + (a == d ? (peri_r)law->lambda * dtrace : 0);
            }
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) {
                dp[a][d] = ds[a][d];
                for (int c = 0; c < PERI_D; ++c) dp[a][d] += dh[a][c] * s[c][d] + h[a][c] * ds[c][d];
            }
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) {
                peri_r q = -constant[PERI__VECTOR * m->stride] * dh[a][d];
                for (int c = 0; c < PERI_D; ++c) q += dp[a][c] * constant[(PERI__INVERSE + peri__packed(PERI_D, c, d)) * m->stride];
                change[(1 + a * PERI_D + d) * m->stride] = (peri_b)q;
            }
    }
}

/* The half of end i: adds w (p g + q e) to c, its change to dc, and what correspondence adds to t. */
PERI_INLINE void PERI_FN(tangent_half)(const peri__tangent *tangent, int64_t i, int64_t j, peri_r weight, const peri_r *xi,
                                       const peri_r *delta, peri_r bond, peri_r e, peri_r de, peri_r *c, peri_r *dc, peri_r *t) {
    const peri_body *b = tangent->body;
    const peri__model *m = b->model;
    const int32_t law = m->laws[m->material[i]].model;
    if (law == PERI_BOND_BASED) {
        const peri_r spring = weight * (peri_r)(0.5 * PERI_FN(pair)(b, i, j)->c) / bond;
        *c += spring * e;
        *dc += spring * de;
        return;
    }
    const peri_b *constant = (const peri_b *)b->constant + m->margin + i, *response = (const peri_b *)b->response + m->margin + i;
    const peri_b *change = (const peri_b *)tangent->change + m->margin + i;
    const peri_r gauge = law == PERI_OTERKUS ? 1 : bond;
    *c += weight * (response[0] * gauge + constant[PERI__SPRING * m->stride] * e);
    *dc += weight * (change[0] * gauge + constant[PERI__SPRING * m->stride] * de);
    if (law != PERI_CORRESPONDENCE) return;
    for (int a = 0; a < PERI_D; ++a) {
        peri_r sum = constant[PERI__VECTOR * m->stride] * delta[a];
        for (int d = 0; d < PERI_D; ++d) sum += change[(1 + a * PERI_D + d) * m->stride] * xi[d];
        t[a] += weight * sum;
    }
}

/* The change of the force density of points [begin, end): to ->q. */
static void PERI_FN(tangent_share)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__tangent *tangent = (const peri__tangent *)context;
    const peri_body *b = tangent->body;
    const peri__model *m = b->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)b->u, *p = (const peri_r *)tangent->p;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        peri_r sum[PERI_D] = { 0 };
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int64_t j = row.ids[k];
            const peri_r bond = ((const peri_b *)row.bond)[k];
            peri_r xi[PERI_D], eta[PERI_D], delta[PERI_D], y[PERI_D], t[PERI_D], along = 0, square = 0, e, length, de = 0, c = 0, dc = 0;
            if (b->alive && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
            for (int d = 0; d < PERI_D; ++d) {
                xi[d] = x[d * m->stride + j] - x[d * m->stride + i];
                eta[d] = u[d * m->stride + j] - u[d * m->stride + i];
                delta[d] = p[d * m->stride + j] - p[d * m->stride + i];
                t[d] = 0;
                y[d] = xi[d] + eta[d];
                along += (2 * xi[d] + eta[d]) * eta[d];
                square += y[d] * y[d];
            }
            length = PERI_ROOT(square) + (peri_r)PERI_TINY;
            e = along / (length + bond);
            for (int d = 0; d < PERI_D; ++d) {
                y[d] /= length;
                de += y[d] * delta[d];
            }
            PERI_FN(tangent_half)(tangent, i, j, ((const peri_b *)row.weight)[k], xi, delta, bond, e, de, &c, &dc, t);
            PERI_FN(tangent_half)(tangent, j, i, ((const peri_b *)row.back)[k], xi, delta, bond, e, de, &c, &dc, t);
            for (int d = 0; d < PERI_D; ++d) sum[d] += t[d] + dc * y[d] + c / length * (delta[d] - y[d] * de);
        }
        for (int d = 0; d < PERI_D; ++d) ((peri_r *)tangent->q)[d * m->stride + i] = sum[d];
    }
}

/* ---- vectors ------------------------------------------------------------------------------------------------------ */

/* d += alpha p, r -= alpha q. sums: |r|^2 of free dofs to a, of held ones to b. */
static void PERI_FN(krylov_step)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->body->model;
    double loose[PERI_BLOCK] = { 0.0 }, fixed[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const int64_t at = d * m->stride + begin;
        peri_r *x = (peri_r *)s->d + at, *r = (peri_r *)s->r + at;
        const peri_r *p = (const peri_r *)s->p + at, *q = (const peri_r *)s->q + at;
        PERI_ON_LANES(m->lanes.isa, step_some, (end - begin, (peri_r)s->alpha, p, q, x, r));
        PERI_ON_LANES(m->lanes.isa, square_some, (end - begin, d, s->held + begin, r, loose, fixed));
    }
    sums->a += peri__add_up(loose);
    sums->b += peri__add_up(fixed);
}

/* p = z + beta p on free dofs, 0 on held ones. */
static void PERI_FN(krylov_turn)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->body->model;
    (void)sums;
    for (int d = 0; d < PERI_D; ++d) {
        peri_r *p = (peri_r *)s->p + d * m->stride + begin;
        const peri_r *z = (const peri_r *)s->z + d * m->stride + begin;
        PERI_ON_LANES(m->lanes.isa, turn_some, (end - begin, d, s->held + begin, (peri_r)s->beta, z, p));
    }
}

/* q = -V q: the force that the change p of displacements needs. sums: p.q to a, p.p to b. */
static void PERI_FN(krylov_force)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->body->model;
    double bent[PERI_BLOCK] = { 0.0 }, square[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *p = (const peri_r *)s->p + d * m->stride + begin;
        peri_r *q = (peri_r *)s->q + d * m->stride + begin;
        PERI_ON_LANES(m->lanes.isa, weigh_some, (end - begin, m->volume + begin, p, q, bent, square));
    }
    sums->a += peri__add_up(bent);
    sums->b += peri__add_up(square);
}

/* z = inverse blocks times r (0 for held dofs, whose rows are 0), or r itself. */
static void PERI_FN(krylov_blocks)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const int64_t stride = s->body->model->stride;
    const peri_r *blocks = (const peri_r *)s->blocks, *r = (const peri_r *)s->r;
    (void)sums;
    for (int a = 0; a < PERI_D; ++a) {
        peri_r *z = (peri_r *)s->z + a * stride;
        for (int64_t i = begin; i < end; ++i) {
            peri_r sum = 0;
            for (int c = 0; blocks && c < PERI_D; ++c) sum += blocks[peri__packed(PERI_D, a, c) * stride + i] * r[c * stride + i];
            z[i] = blocks ? sum : s->held[i] >> a & 1 ? 0 : r[a * stride + i];
        }
    }
}

/* sums: |r|^2 of free dofs to a, of held ones to b. */
static void PERI_FN(krylov_norm)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->body->model;
    double loose[PERI_BLOCK] = { 0.0 }, fixed[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *r = (const peri_r *)s->r + d * m->stride + begin;
        PERI_ON_LANES(m->lanes.isa, square_some, (end - begin, d, s->held + begin, r, loose, fixed));
    }
    sums->a += peri__add_up(loose);
    sums->b += peri__add_up(fixed);
}

/* sums: r.z over free dofs to a. */
static void PERI_FN(krylov_dot)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->body->model;
    double sum[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *r = (const peri_r *)s->r + d * m->stride + begin, *z = (const peri_r *)s->z + d * m->stride + begin;
        PERI_ON_LANES(m->lanes.isa, dot_some, (end - begin, d, s->held + begin, r, z, sum));
    }
    sums->a += peri__add_up(sum);
}
