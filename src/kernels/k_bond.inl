/* k_bond.inl - bond-based force, breaking and energy ([T] 1.20-1.23, [P] 1, 9, 10):

       f_i = sum_j c w(|xi|) s M beta_ij V_j,    s = e/|xi|,    e = |xi+eta| - |xi|,    M = (xi+eta)/|xi+eta|
       W_i = 1/2 sum_j (1/2 c w s^2 |xi|) beta_ij V_j

   weight = w beta V_j is stored. The extension is taken as e = (2 xi.eta + eta.eta)/(|xi+eta| + |xi|): the difference of two
   lengths loses every digit at strains of 1e-7 in single precision, this form none.
   Each row adds its own bonds in the order of the list and writes only to its own point. Both ends of a bond compute the same e to the last
   bit (only signs differ), so both find it broken in the same step without telling each other. */

/* Component d of xi of bond k of a row, where the places of its ends are `apart`. Points decide about the bonds that they share each for
   itself: they must take the same xi, and so must columns and rows. */
PERI_INLINE peri_b PERI_FN(xi_of)(const peri__row *row, int64_t k, int d, peri_r apart) {
    return row->vector ? (peri_b)row->table[row->vector[k] * PERI_TABLE_ROW + d] : (peri_b)apart;
}

/* Bond k of row i: reference bond xi and relative displacement eta. */
PERI_INLINE void PERI_FN(bond_vectors)(const peri_body *b, int64_t i, const peri__row *row, int64_t k, peri_b *xi, peri_b *eta) {
    const peri__model *m = b->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)b->u;
    const int64_t j = row->ids[k];
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *xd = x + d * m->stride, *ud = u + d * m->stride;
        xi[d] = m->centroid ? ((const peri_b *)m->centroid)[(row->first + k) * PERI_D + d] : PERI_FN(xi_of)(row, k, d, xd[j] - xd[i]);
        eta[d] = (peri_b)(ud[j] - ud[i]);
    }
}

/* Extension e of a bond and the vector y along which its force acts: xi+eta, or xi where the geometry is linear. Returns |y|. */
PERI_INLINE peri_b PERI_FN(extension)(int linear, const peri_b *xi, const peri_b *eta, peri_b bond, peri_b *e, peri_b *y) {
    peri_b along = 0, square = 0, length;
    for (int d = 0; d < PERI_D; ++d) {
        if (linear) {
            y[d] = xi[d];
            along += xi[d] * eta[d];
        } else {
            y[d] = xi[d] + eta[d];
            along += (2 * xi[d] + eta[d]) * eta[d];
            square += y[d] * y[d];
        }
    }
    if (linear) {
        *e = along / bond;
        return bond;
    }
    length = PERI_SQRT(square);
    *e = along / (length + bond);
    return length;
}

PERI_INLINE const peri__pair *PERI_FN(pair)(const peri_body *b, int64_t i, int64_t j) {
    return b->cls ? &b->pairs[b->cls[i] * b->classes + b->cls[j]] : b->pairs;
}

/* Stretch of bond (i, j) as point j sees it. With centroid bonds the two ends differ; the end of lower id decides for both. */
static peri_b PERI_FN(other_stretch)(const peri_body *b, int64_t i, int64_t j) {
    peri_b xi[PERI_D], eta[PERI_D], y[PERI_D], e;
    peri__row row;
    peri__read_row(b, j, &row);
    const int64_t k = peri__find_bond(b->model, j, i);
    const peri_b bond = ((const peri_b *)row.bond)[k];
    PERI_FN(bond_vectors)(b, j, &row, k, xi, eta);
    (void)PERI_FN(extension)(b->desc.geometry == PERI_LINEAR, xi, eta, bond, &e, y);
    return e / bond;
}

/* The textbook kernel of one row: every quantity by its formula. f, impulse: [PERI_D] of row i, see the row below. */
static int32_t PERI_FN(bond_row_reference)(const peri__step *step, int64_t i, const peri__row *row, peri_r *f, peri_r *impulse,
                                           double *lost) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    int linear = b->desc.geometry == PERI_LINEAR;
    int32_t broke = 0;
    for (int64_t k = 0; k < row->count; ++k) {
        const int64_t j = row->ids[k];
        uint32_t *flags = b->alive ? &b->alive[i * m->words + k / 32] : NULL, flag = (uint32_t)1 << (k % 32);
        const peri__pair *pair = PERI_FN(pair)(b, i, j);
        peri_b xi[PERI_D], eta[PERI_D], y[PERI_D], e, s, length, force;
        peri_b bond = ((const peri_b *)row->bond)[k], weight = ((const peri_b *)row->weight)[k];
        if (flags && !(*flags & flag)) continue;
        PERI_FN(bond_vectors)(b, i, row, k, xi, eta);
        length = PERI_FN(extension)(linear, xi, eta, bond, &e, y);
        s = e / bond;
        force = (peri_b)pair->c * s * weight;
        if (step->breaking && flags && (m->centroid && j < i ? PERI_FN(other_stretch)(b, i, j) : s) > (peri_b)pair->s0) {
            *flags &= ~flag;
            broke++;
            *lost += 0.25 * pair->c * (double)weight * (double)s * (double)s * (double)bond * m->volume[i];
            for (int d = 0; d < PERI_D; ++d) impulse[d] += force * y[d] / (length + PERI_TINY);
        } else {
            for (int d = 0; d < PERI_D; ++d) f[d] += force * y[d] / (length + PERI_TINY);
        }
    }
    return broke;
}

/* The same row, for speed: one square root and one division per bond, the flags of 32 bonds read at once. `flagged` is a
   constant where this is inlined. f gets the force of the bonds that live on; impulse that of the bonds that break now, which
   still act in the closing half kick of the step (PERI_BREAK_AT_STEP_END). Returns the number of bonds broken. */
PERI_INLINE int32_t PERI_FN(bond_row)(const peri__step *step, int64_t i, const peri__row *row, peri_r *f, peri_r *impulse,
                                      double *lost, const int flagged, const int linear) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)b->u;
    const peri_b *bonds = (const peri_b *)row->bond, *weights = (const peri_b *)row->weight;
    const int32_t *ids = row->ids;
    const uint8_t *cls = b->cls;
    const peri__pair *pairs = cls ? &b->pairs[cls[i] * b->classes] : b->pairs;
    const int64_t stride = m->stride;
    /* infinite, so that no change of displacement breaks a bond where the tangent asks */
    peri_b c = (peri_b)pairs->c, s0 = step->breaking ? (peri_b)pairs->s0 : (peri_b)HUGE_VAL;
    int32_t broke = 0, count = (int32_t)row->count;
    peri_r xi_[PERI_D], ui[PERI_D], sum[PERI_D];
    for (int d = 0; d < PERI_D; ++d) {
        xi_[d] = x[d * stride + i];
        ui[d] = u[d * stride + i];
        sum[d] = f[d];
    }
    for (int32_t first = 0; first < count; first += 32) {
        uint32_t *flags = flagged ? &b->alive[i * m->words + first / 32] : NULL;
        uint32_t live = flagged ? *flags : 0, dead = 0;
        int32_t chunk = count - first < 32 ? count - first : 32;
        for (int32_t k = 0; k < chunk; ++k) {
            int64_t j = ids[first + k];
            peri_b xi[PERI_D], eta[PERI_D], y[PERI_D], along = 0, square = 0, length, scale, reach;
            peri_b bond = bonds[first + k], weight = weights[first + k];
            if (flagged && !(live >> k & 1)) continue;
            if (cls) {
                c = (peri_b)pairs[cls[j]].c;
                s0 = step->breaking ? (peri_b)pairs[cls[j]].s0 : (peri_b)HUGE_VAL;
            }
            for (int d = 0; d < PERI_D; ++d) {
                xi[d] = PERI_FN(xi_of)(row, first + k, d, x[d * stride + j] - xi_[d]);
                eta[d] = (peri_b)(u[d * stride + j] - ui[d]);
                if (linear) {
                    y[d] = xi[d];
                    along += xi[d] * eta[d];
                } else {
                    y[d] = xi[d] + eta[d];
                    along += (2 * xi[d] + eta[d]) * eta[d];
                    square += y[d] * y[d];
                }
            }
            /* e = along/reach, force along y: c weight e/(bond |y|) */
            length = linear ? bond : PERI_SQRT(square);
            reach = linear ? bond : length + bond;
            if (linear) {
                const peri_b inverse = 1 / bond;
                scale = c * weight * (inverse * inverse * inverse) * along;
            } else
                scale = c * weight * along / (reach * bond * (length + PERI_TINY));
            if (flagged && along > s0 * bond * reach) {
                double s = (double)along / ((double)reach * (double)bond);
                dead |= (uint32_t)1 << k;
                *lost += 0.25 * (double)c * (double)weight * s * s * (double)bond * m->volume[i];
                for (int d = 0; d < PERI_D; ++d) impulse[d] += scale * y[d];
                broke++;
                continue;
            }
            for (int d = 0; d < PERI_D; ++d) sum[d] += scale * y[d];
        }
        if (flagged && dead) *flags = live & ~dead;
    }
    for (int d = 0; d < PERI_D; ++d) f[d] = sum[d];
    return broke;
}
