/* k_state.inl - state-based force and energy ([T] 1.80, [C] 1-21), for any mixture of laws in one body:

       f_i = sum_j (T_i + T_j) V_j,    T_i = w [(p_i g + q_i e) M + Q_i xi + k_i eta]

   is what the end i gives to bond (i, j). Two passes: `respond` makes p_i (from theta) and Q_i (from F) of every point, `share` adds the
   halves of both ends. weight = w_ij beta V_j weighs the own half, back = w_ji beta V_j that of j; both are of the same force on i.
   Seen from j the same sum has the opposite sign, term by term: momentum is conserved whatever the laws of the two ends are. */

/* The half of end i of its bond with j: adds to the central part (along M) and, correspondence, to the vector t. */
PERI_INLINE void PERI_FN(half_bond)(const peri_body *b, int64_t i, int64_t j, peri_b weight, const peri_b *xi, const peri_b *eta,
                                    peri_b bond, peri_b e, peri_b *central, peri_b *t) {
    const peri__model *m = b->model;
    const int32_t law = m->laws[m->material[i]].model;
    const peri_b *constant = (const peri_b *)b->constant + m->margin + i, *response = (const peri_b *)b->response + m->margin + i;
    peri_b half; /* rounded before it is added: both ends must come to the same sum, where registers are wider (x87), too */
    if (law == PERI_BOND_BASED) half = weight * (peri_b)(0.5 * PERI_FN(pair)(b, i, j)->c) * e / bond;
    else half = weight * (response[0] * (law == PERI_OTERKUS ? 1 : bond) + constant[PERI__SPRING * m->stride] * e);
    *central += half;
    if (law != PERI_CORRESPONDENCE) return;
    for (int a = 0; a < PERI_D; ++a) {
        peri_b sum = constant[PERI__VECTOR * m->stride] * eta[a];
        for (int d = 0; d < PERI_D; ++d) sum += response[(1 + a * PERI_D + d) * m->stride] * xi[d];
        half = weight * sum;
        t[a] += half;
    }
}

/* Row i, every quantity by its formula: adds to f, and notes what the criteria need. Returns the number of bonds that meet one. */
static int32_t PERI_FN(share_row_reference)(const peri__step *step, int64_t i, const peri__row *row, peri_r *f) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    const int linear = b->desc.geometry == PERI_LINEAR;
    int32_t dying = 0;
    if (step->breaking)
        for (int32_t k = 0; k < m->words; ++k) b->dying[i * m->words + k] = 0;
    for (int64_t k = 0; k < row->count; ++k) {
        const int64_t at = row->first + k, j = row->ids[k];
        peri_b xi[PERI_D], eta[PERI_D], y[PERI_D], t[PERI_D], e, central = 0, length;
        const peri_b bond = ((const peri_b *)row->bond)[k];
        if (b->alive && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
        PERI_FN(bond_vectors)(b, i, row, k, xi, eta);
        length = PERI_FN(extension)(linear, xi, eta, bond, &e, y);
        for (int d = 0; d < PERI_D; ++d) t[d] = 0;
        PERI_FN(half_bond)(b, i, j, ((const peri_b *)row->weight)[k], xi, eta, bond, e, &central, t);
        PERI_FN(half_bond)(b, j, i, ((const peri_b *)row->back)[k], xi, eta, bond, e, &central, t);
        for (int d = 0; d < PERI_D; ++d) {
            t[d] += central * y[d] / (length + PERI_TINY);
            f[d] += t[d];
        }
        if (step->working) { /* the work of t along the way since last time, by the trapezoidal rule */
            const peri_r *worked = (const peri_r *)b->worked;
            peri_r *pull = (peri_r *)b->pull + at * PERI_D, *work = (peri_r *)b->work + at;
            for (int d = 0; d < PERI_D; ++d) {
                const peri_r *w = worked + d * m->stride;
                *work += (peri_r)0.5 * (pull[d] + t[d]) * (eta[d] - (w[j] - w[i]));
                pull[d] = t[d];
            }
        }
        if (step->breaking && e > 0) {
            const peri__pair *pair = PERI_FN(pair)(b, i, j);
            const double share = row->part ? (double)row->part[k] : m->volume[j];
            int dies = e / bond > (peri_b)pair->s0;
            if (b->work) dies |= (double)((const peri_r *)b->work)[at] > pair->bond_energy * share;
            if (b->node) dies |= 0.5 * (b->node[i] + b->node[j]) > pair->node_energy;
            if (dies) b->dying[i * m->words + k / 32] |= (uint32_t)1 << (k % 32);
            dying += dies;
        }
    }
    return dying;
}

/* The same row where every point is of one ordinary law: constants at hand, one square root and one division per bond. `flagged`
   is a constant where this is inlined; where nothing dilates p is 0. */
PERI_INLINE int32_t PERI_FN(share_row)(const peri__step *step, int64_t i, const peri__row *row, peri_r *f, const int flagged,
                                       const int linear, const int oterkus, const int mirrored) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    const int64_t stride = m->stride;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)b->u;
    const peri_b *p = (const peri_b *)b->response + m->margin, *q = (const peri_b *)b->constant + m->margin + PERI__SPRING * stride;
    const peri_b *bonds = (const peri_b *)row->bond, *weights = (const peri_b *)row->weight, *backs = (const peri_b *)row->back;
    const int32_t *ids = row->ids;
    const uint8_t *cls = b->cls;
    const peri__pair *pairs = cls ? &b->pairs[cls[i] * b->classes] : b->pairs;
    peri_r here[PERI_D], moved[PERI_D], sum[PERI_D];
    peri_b s0 = (peri_b)pairs->s0;
    const peri_b qi = q[i], pi = p[i];
    int32_t dying = 0;
    for (int d = 0; d < PERI_D; ++d) {
        here[d] = x[d * stride + i];
        moved[d] = u[d * stride + i];
        sum[d] = f[d];
    }
    for (int32_t first = 0, count = (int32_t)row->count; first < count; first += 32) {
        const uint32_t live = flagged ? b->alive[i * m->words + first / 32] : 0;
        const int32_t chunk = count - first < 32 ? count - first : 32;
        uint32_t dead = 0;
        for (int32_t k = 0; k < chunk; ++k) {
            const int64_t j = ids[first + k];
            const peri_b bond = bonds[first + k], gauge = oterkus ? 1 : bond;
            peri_b weight = weights[first + k], back = mirrored ? weight : backs[first + k];
            peri_b y[PERI_D], along = 0, square = 0, length, reach, pull;
            if (flagged && !(live >> k & 1)) continue;
            for (int d = 0; d < PERI_D; ++d) {
                const peri_b xi = PERI_FN(xi_of)(row, first + k, d, x[d * stride + j] - here[d]);
                const peri_b eta = (peri_b)(u[d * stride + j] - moved[d]);
                y[d] = linear ? xi : xi + eta;
                along += (linear ? xi : 2 * xi + eta) * eta;
                square += y[d] * y[d];
            }
            /* e = along/reach, force along y: w (p g + q e)/|y| */
            length = linear ? bond : PERI_SQRT(square);
            reach = linear ? bond : length + bond;
            if (linear) { /* over |xi|^2 here */
                const peri_b inverse = 1 / bond;
                weight *= inverse * inverse;
                back *= inverse * inverse;
            }
            if (mirrored) pull = weight * ((qi + q[j]) * along + (pi + p[j]) * gauge * reach);
            else pull = (weight * qi + back * q[j]) * along + (weight * pi + back * p[j]) * gauge * reach;
            if (!linear) pull /= reach * (length + PERI_TINY);
            for (int d = 0; d < PERI_D; ++d) sum[d] += pull * y[d];
            if (flagged && step->breaking) {
                if (cls) s0 = (peri_b)pairs[cls[j]].s0;
                if (along > s0 * bond * reach) {
                    dead |= (uint32_t)1 << k;
                    dying++;
                }
            }
        }
        if (flagged && step->breaking) b->dying[i * m->words + first / 32] = dead;
    }
    for (int d = 0; d < PERI_D; ++d) f[d] = sum[d];
    return dying;
}

/* Force density of the bonds of row i, by whichever of the two serves; adds to f. */
static int32_t PERI_FN(share_force)(const peri__step *step, int64_t i, peri_r *f) {
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const int linear = b->desc.geometry == PERI_LINEAR, plain = b->desc.kernel == PERI_KERNEL_REFERENCE || m->works || m->nodes;
    const int oterkus = m->ordinary == PERI_OTERKUS, mirrored = m->back == m->weight;
    peri__row row;
    peri__read_row(b, i, &row);
    if (plain || !m->ordinary) return PERI_FN(share_row_reference)(step, i, &row, f);
    if (!b->alive) return PERI_FN(share_row)(step, i, &row, f, 0, linear, oterkus, mirrored);
    return PERI_FN(share_row)(step, i, &row, f, 1, linear, oterkus, mirrored);
}

/* Rows [begin, end), one by one. */
static void PERI_FN(share_rows)(const peri__step *step, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__model *m = step->body->model;
    peri_r *force = (peri_r *)step->body->f;
    for (int64_t i = begin; i < end; ++i) {
        peri_r f[PERI_D];
        for (int d = 0; d < PERI_D; ++d) f[d] = force[d * m->stride + i];
        sums->n += PERI_FN(share_force)(step, i, f);
        for (int d = 0; d < PERI_D; ++d) force[d * m->stride + i] = f[d];
    }
}

/* Adds the internal force density to f and notes in `dying` which bonds meet their criterion: by columns where there are any; by rows
   in groups where a bond is about to break, or where correspondence points act by central bonds. sums: n their (directed) number. */
static void PERI_FN(share)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__step *step = (const peri__step *)context;
    const peri__model *m = step->body->model;
    for (int64_t k = begin; m->slots && k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r *force = (peri_r *)step->body->f + i, f[PERI_D];
        PERI_FN(fetch_ahead)(step->body, k);
        for (int d = 0; d < PERI_D; ++d) f[d] = force[d * m->stride];
        int by_row = m->tensors && step->body->central[i / PERI_LANES];
        if (!by_row)
            by_row = m->tensors ? PERI_ON_LANES(m->lanes.isa, list_tensor, (step, k, f))
                                : PERI_ON_LANES(m->lanes.isa, list_share, (step, k, f));
        if (by_row) PERI_FN(share_rows)(step, i, i + 1, sums);
        else
            for (int d = 0; d < PERI_D; ++d) force[d * m->stride] = f[d];
    }
    if (m->slots) return;
    if (!m->lanes.columns) {
        PERI_FN(share_rows)(step, begin, end, sums);
        return;
    }
    for (int64_t first = begin; first < end; first += PERI_LANES) {
        peri_r *force = (peri_r *)step->body->f + first, f[PERI_D][PERI_LANES];
        const int64_t g = first / PERI_LANES;
        uint32_t by_row = 0xFFFF;
        for (int d = 0; d < PERI_D; ++d)
            for (int l = 0; l < PERI_LANES; ++l) f[d][l] = force[d * m->stride + l];
        if (!m->tensors) by_row = PERI_ON_LANES(m->lanes.isa, share, (step, g, f));
        else if (!step->body->central[g]) by_row = PERI_ON_LANES(m->lanes.isa, tensor, (step, g, f));
        for (int l = 0; by_row && l < PERI_LANES && first + l < end; ++l)
            if (by_row >> l & 1) PERI_FN(share_rows)(step, first + l, first + l + 1, sums);
        for (int d = 0; d < PERI_D; ++d)
            for (int l = 0; l < PERI_LANES; ++l) force[d * m->stride + l] = by_row >> l & 1 ? force[d * m->stride + l] : f[d][l];
    }
}

/* For the points of a list: takes the force that their bonds give out of f (sign -1), or puts it in (1), and gives the opposite of it for
   the time step->impulse to v. */
static void PERI_FN(exchange)(const peri__step *step, const int32_t *points, int64_t count, int sign) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    for (int64_t k = 0; k < count; ++k) {
        const int64_t i = points[k];
        const peri_r kick = (peri_r)(step->impulse / m->rho[m->material[i]]);
        peri_r f[PERI_D];
        for (int d = 0; d < PERI_D; ++d) f[d] = 0;
        (void)PERI_FN(share_force)(step, i, f);
        for (int d = 0; d < PERI_D; ++d) {
            ((peri_r *)b->f)[d * m->stride + i] += (peri_r)sign * f[d];
            ((peri_r *)b->v)[d * m->stride + i] -= (peri_r)sign * kick * f[d];
        }
    }
}

/* sum w eta xi V of a correspondence point. */
static void PERI_FN(shape)(const peri_body *b, int64_t i, const peri__row *row, peri_r n[PERI_D][PERI_D]) {
    const peri__model *m = b->model;
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) n[a][d] = 0;
    for (int64_t k = 0; k < row->count; ++k) {
        const peri_b weight = ((const peri_b *)row->weight)[k];
        peri_b xi[PERI_D], eta[PERI_D];
        if (b->alive && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
        PERI_FN(bond_vectors)(b, i, row, k, xi, eta);
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) n[a][d] += weight * eta[a] * xi[d];
    }
}

/* Displacement gradient H = (sum w eta xi V) K^-1. */
static void PERI_FN(gradient)(const peri_body *b, int64_t i, peri_r n[PERI_D][PERI_D], peri_r h[PERI_D][PERI_D]) {
    const peri__model *m = b->model;
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) {
            h[a][d] = 0;
            for (int c = 0; c < PERI_D; ++c)
                h[a][d] += n[a][c]
                         * ((const peri_b *)b->constant)[m->margin + (PERI__INVERSE + peri__packed(PERI_D, c, d)) * m->stride + i];
        }
}

/* Strain of H: 1/2 (H + H^T), and 1/2 H^T H more where the geometry is not linear. */
static void PERI_FN(strain)(int linear, peri_r h[PERI_D][PERI_D], peri_r strain[PERI_D][PERI_D]) {
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) {
            strain[a][d] = (peri_r)0.5 * (h[a][d] + h[d][a]);
            for (int c = 0; !linear && c < PERI_D; ++c) strain[a][d] += (peri_r)0.5 * h[c][a] * h[c][d];
        }
}

/* Q_i = P K^-1 - k H, so that T = w (P K^-1 xi + k (eta - H xi)); P = sigma, or F S. */
static void PERI_FN(respond_tensor)(peri_body *b, int64_t i, peri_r n[PERI_D][PERI_D]) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    const int linear = b->desc.geometry == PERI_LINEAR;
    const peri_b *constant = (const peri_b *)b->constant + m->margin + i;
    const peri_r lambda = (peri_r)law->lambda, mu2 = (peri_r)(2.0 * law->mu);
    peri_b *response = (peri_b *)b->response + m->margin + i;
    peri_r h[PERI_D][PERI_D], s[PERI_D][PERI_D], p[PERI_D][PERI_D], trace = 0;
    PERI_FN(gradient)(b, i, n, h);
    PERI_FN(strain)(linear, h, s);
    for (int a = 0; a < PERI_D; ++a) trace += s[a][a];
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) s[a][d] = mu2 * s[a][d] + (a == d ? lambda * trace : 0);
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) {
            p[a][d] = s[a][d];
            for (int c = 0; !linear && c < PERI_D; ++c) p[a][d] += h[a][c] * s[c][d];
        }
    response[0] = 0;
    for (int a = 0; a < PERI_D; ++a)
        for (int d = 0; d < PERI_D; ++d) {
            peri_r q = -constant[PERI__VECTOR * m->stride] * h[a][d];
            for (int c = 0; c < PERI_D; ++c) q += p[a][c] * constant[(PERI__INVERSE + peri__packed(PERI_D, c, d)) * m->stride];
            response[(1 + a * PERI_D + d) * m->stride] = (peri_b)q;
        }
}

/* sum w g e V of an ordinary point; *square: sum w e^2 V. */
static double PERI_FN(stretched)(const peri_body *b, int64_t i, const peri__row *row, double *square) {
    const peri__model *m = b->model;
    const int linear = b->desc.geometry == PERI_LINEAR, oterkus = m->laws[m->material[i]].model == PERI_OTERKUS;
    peri_r sum = 0;
    double squares = 0.0;
    for (int64_t k = 0; k < row->count; ++k) {
        const peri_b bond = ((const peri_b *)row->bond)[k], weight = ((const peri_b *)row->weight)[k];
        peri_b xi[PERI_D], eta[PERI_D], y[PERI_D], e;
        if (b->alive && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
        PERI_FN(bond_vectors)(b, i, row, k, xi, eta);
        (void)PERI_FN(extension)(linear, xi, eta, bond, &e, y);
        sum += weight * (oterkus ? 1 : bond) * e;
        squares += (double)weight * (double)e * (double)e;
    }
    *square = squares;
    return (double)sum;
}

/* The same sum w g e V for speed, without that of squares. */
static peri_r PERI_FN(stretched_row)(const peri_body *b, int64_t i, const peri__row *row, const int oterkus, const int flagged,
                                     const int linear) {
    const peri__model *m = b->model;
    const int64_t stride = m->stride;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)b->u;
    const peri_b *bonds = (const peri_b *)row->bond, *weights = (const peri_b *)row->weight;
    const int32_t *ids = row->ids;
    peri_r here[PERI_D], moved[PERI_D], sum = 0;
    for (int d = 0; d < PERI_D; ++d) {
        here[d] = x[d * stride + i];
        moved[d] = u[d * stride + i];
    }
    for (int64_t k = 0; k < row->count; ++k) {
        const int64_t j = ids[k];
        const peri_b bond = bonds[k], gauge = linear ? (oterkus ? 1 / bond : 1) : oterkus ? 1 : bond, weight = weights[k] * gauge;
        peri_b along = 0, square = 0;
        if (flagged && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
        for (int d = 0; d < PERI_D; ++d) {
            const peri_b xi = PERI_FN(xi_of)(row, k, d, x[d * stride + j] - here[d]), eta = (peri_b)(u[d * stride + j] - moved[d]);
            const peri_b y = xi + eta;
            along += (linear ? xi : 2 * xi + eta) * eta;
            square += y * y;
        }
        sum += linear ? weight * along : weight * (along / (PERI_SQRT(square) + bond));
    }
    return sum;
}

/* By whichever of the two serves. */
static peri_r PERI_FN(stretched_sum)(const peri_body *b, int64_t i, const peri__row *row) {
    const int linear = b->desc.geometry == PERI_LINEAR, oterkus = b->model->laws[b->model->material[i]].model == PERI_OTERKUS;
    double square;
    if (b->desc.kernel == PERI_KERNEL_REFERENCE) return (peri_r)PERI_FN(stretched)(b, i, row, &square);
    return PERI_FN(stretched_row)(b, i, row, oterkus, b->alive != NULL, linear);
}

/* Energy density of point i. */
static double PERI_FN(point_energy)(const peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    const int linear = b->desc.geometry == PERI_LINEAR;
    double density = 0.0, square = 0.0;
    if (law->model == PERI_BOND_BASED) {
        for (int64_t k = 0; k < row->count; ++k) {
            const int64_t j = row->ids[k];
            peri_b xi[PERI_D], eta[PERI_D], y[PERI_D], e;
            const peri_b bond = ((const peri_b *)row->bond)[k], weight = ((const peri_b *)row->weight)[k];
            if (b->alive && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
            PERI_FN(bond_vectors)(b, i, row, k, xi, eta);
            (void)PERI_FN(extension)(linear, xi, eta, bond, &e, y);
            density += 0.25 * PERI_FN(pair)(b, i, j)->c * (double)weight * (double)e * (double)e / (double)bond;
        }
        return density;
    }
    const peri_b *constant = (const peri_b *)b->constant + m->margin + i;
    double sum = PERI_FN(stretched)(b, i, row, &square), dilate = (double)constant[PERI__DILATE * m->stride];
    density = 0.5 * (double)constant[PERI__SPRING * m->stride] * square;
    if (law->model != PERI_CORRESPONDENCE) return density + 0.5 * (double)constant[PERI__PRESS * m->stride] * dilate * sum * sum;

    peri_r n[PERI_D][PERI_D], h[PERI_D][PERI_D], s[PERI_D][PERI_D];
    double trace = 0.0, norm = 0.0, apart = 0.0;
    PERI_FN(shape)(b, i, row, n);
    PERI_FN(gradient)(b, i, n, h);
    PERI_FN(strain)(linear, h, s);
    for (int a = 0; a < PERI_D; ++a) {
        trace += (double)s[a][a];
        for (int d = 0; d < PERI_D; ++d) norm += peri__square((double)s[a][d]);
    }
    for (int64_t k = 0; k < row->count; ++k) { /* sum w |Y - F xi|^2 V */
        peri_b xi[PERI_D], eta[PERI_D];
        if (b->alive && !(b->alive[i * m->words + k / 32] >> (k % 32) & 1)) continue;
        PERI_FN(bond_vectors)(b, i, row, k, xi, eta);
        for (int a = 0; a < PERI_D; ++a) {
            peri_r z = eta[a];
            for (int d = 0; d < PERI_D; ++d) z -= h[a][d] * xi[d];
            apart += (double)((const peri_b *)row->weight)[k] * peri__square((double)z);
        }
    }
    return density + 0.5 * law->lambda * trace * trace + law->mu * norm + 0.5 * (double)constant[PERI__VECTOR * m->stride] * apart;
}

/* What points make of their families: p, Q, and where a criterion asks for it the energy of the node. */
static void PERI_FN(respond_rows)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__step *step = (const peri__step *)context;
    peri_body *b = step->body;
    const peri__model *m = b->model;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        const int32_t law = m->laws[m->material[i]].model;
        const peri_b *constant = (const peri_b *)b->constant + m->margin + i;
        peri_r n[PERI_D][PERI_D];
        peri__read_row(b, i, &row);
        if (law == PERI_CORRESPONDENCE) {
            PERI_FN(shape)(b, i, &row, n);
            PERI_FN(respond_tensor)(b, i, n);
        } else if (law != PERI_BOND_BASED)
            ((peri_b *)b->response)[m->margin + i] =
                constant[PERI__PRESS * m->stride] == 0
                    ? 0 /* the product of the two constants alone can leave the range of float */
                    : (peri_b)(constant[PERI__PRESS * m->stride]
                               * (constant[PERI__DILATE * m->stride] * PERI_FN(stretched_sum)(b, i, &row)));
        if (b->node) b->node[i] = 2.0 * PERI_FN(point_energy)(b, i, &row) / peri__family_volume(m, i);
    }
}

/* The same for a block of points, by columns where there are any. */
static void PERI_FN(respond)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri_body *b = ((const peri__step *)context)->body;
    const peri__model *m = b->model;
    for (int64_t k = begin; m->slots && k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        PERI_FN(fetch_ahead)(b, k);
        if (m->tensors) {
            peri_r n[PERI_D][PERI_D];
            PERI_ON_LANES(m->lanes.isa, list_shape, (b, k, n));
            PERI_FN(respond_tensor)(b, i, n);
            continue;
        }
        const peri_b *constant = (const peri_b *)b->constant + m->margin + i, press = constant[PERI__PRESS * m->stride];
        const peri_r sum = press == 0 ? 0 : PERI_ON_LANES(m->lanes.isa, list_stretched, (b, k));
        ((peri_b *)b->response)[m->margin + i] = (peri_b)(press * (constant[PERI__DILATE * m->stride] * sum));
    }
    if (m->slots) return;
    if (!m->lanes.columns) {
        PERI_FN(respond_rows)(context, begin, end, sums);
        return;
    }
    for (int64_t first = begin; first < end; first += PERI_LANES) {
        const peri_b *constant = (const peri_b *)b->constant + m->margin + first;
        peri_b *response = (peri_b *)b->response + m->margin + first;
        peri_r sum[PERI_LANES];
        const int64_t g = first / PERI_LANES;
        const int gauged = m->ordinary != PERI_OTERKUS;
        if (m->tensors) {
            peri_r shape[PERI_D][PERI_D][PERI_LANES], n[PERI_D][PERI_D];
            PERI_ON_LANES(m->lanes.isa, shape, (b, g, shape));
            for (int64_t i = first; i < peri__min(first + PERI_LANES, end); ++i) {
                for (int a = 0; a < PERI_D; ++a)
                    for (int d = 0; d < PERI_D; ++d) n[a][d] = shape[a][d][i - first];
                PERI_FN(respond_tensor)(b, i, n);
            }
            continue;
        }
        PERI_ON_LANES(m->lanes.isa, stretched, (b, g, gauged, sum));
        for (int l = 0; l < PERI_LANES; ++l)
            response[l] = (peri_b)(constant[PERI__PRESS * m->stride + l] * (constant[PERI__DILATE * m->stride + l] * sum[l]));
    }
}

/* Energy densities of group g, by columns; not of correspondence. */
static void PERI_FN(group_energy)(const peri_body *b, int64_t g, double density[PERI_LANES]) {
    const peri__model *m = b->model;
    const peri_b *constant = m->states ? (const peri_b *)b->constant + m->margin + g * PERI_LANES : NULL;
    peri_r sum[PERI_LANES] = { 0 };
    PERI_ON_LANES(m->lanes.isa, squares, (b, g, density));
    if (m->dilates) PERI_ON_LANES(m->lanes.isa, stretched, (b, g, m->ordinary != PERI_OTERKUS, sum));
    for (int l = 0; l < PERI_LANES; ++l) {
        if (!m->states) density[l] *= 0.25;
        else
            density[l] = 0.5 * (double)constant[PERI__SPRING * m->stride + l] * density[l]
                       + 0.5 * (double)constant[PERI__PRESS * m->stride + l] * (double)constant[PERI__DILATE * m->stride + l]
                             * peri__square((double)sum[l]);
    }
}

/* Elastic energy of live bonds: sums->a, and per point to step->out where it is not NULL. By rows, too, of points that begin within a
   group. */
static void PERI_FN(energy)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__step *step = (const peri__step *)context;
    const peri_body *b = step->body;
    const peri__model *m = b->model;
    const int columns = m->lanes.columns > 0 && !m->tensors && begin % PERI_LANES == 0;
    double group[PERI_LANES];
    peri__row row;
    for (int64_t i = begin; i < end; ++i) {
        if (columns && i % PERI_LANES == 0) PERI_FN(group_energy)(b, i / PERI_LANES, group);
        if (!columns) peri__read_row(b, i, &row);
        const double density = columns ? group[i % PERI_LANES] : PERI_FN(point_energy)(b, i, &row);
        if (step->out) step->out[i] = density;
        sums->a += density * m->volume[i];
    }
}
