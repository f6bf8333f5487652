/* SPDX-License-Identifier: MIT */
/* passes.inl - passes over blocks of points: by columns or by the list, and by rows where a bond is about to break, or where families are
   stored in no other way. What works on vectors they call by the instruction set of the body. */

#define PERI_BY_VECTORS(model, name) PERI_FN(vectors)[(model)->stencil.isa].name

/* Can a bond of point i be over a criterion of stress? A measure of the mean of two stresses is at most the mean of theirs. */
PERI_INLINE int PERI_FN(near_stress)(const peri__operands *o, int64_t i) {
    return o->breaking && o->nearness && 0.5 * (o->nearness[i] + o->nearness_most) > 1.0 - 1e-6;
}

/* Can a bond of point i be beyond the critical energy of its ends? */
PERI_INLINE int PERI_FN(near_node_energy)(const peri__operands *o, int64_t i) {
    if (!o->node || !o->breaking) return 0;
    const double limit = peri__least_limit(o, i, PERI_CRITERION_NODE_ENERGY) * peri__square(o->least_strength);
    return 0.5 * (o->node[i] + o->node_most) > limit;
}

/* ---- the list ------------------------------------------------------------------------------------------------------ */

/* Records of list.inl. */
static void PERI_FN(fill_records)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *o = (const peri__operands *)context;
    const peri__model *m = o->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)o->u;
    const peri_b *p = (const peri_b *)o->response, *q = m->pairwise ? NULL : (const peri_b *)o->constant + PERI__SPRING * m->stride;
    (void)sums;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r *record = (peri_r *)o->records + k * m->record_reals;
        for (int d = 0; d < PERI_D; ++d) {
            record[d] = x[d * m->stride + i];
            record[PERI_D + d] = u[d * m->stride + i];
        }
        if (m->gathers & PERI__GRADIENT) continue;
        if (!m->pairwise) {
            record[2 * PERI_D] = p[i];
            record[2 * PERI_D + 1] = q[i];
        } else if (m->record_reals > 2 * PERI_D)
            record[2 * PERI_D] = (peri_r)m->material[i];
    }
}

/* And what points respond with: p, or Q and k. */
static void PERI_FN(fill_responses)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *o = (const peri__operands *)context;
    const peri__model *m = o->model;
    const peri_b *response = (const peri_b *)o->response, *constant = (const peri_b *)o->constant;
    (void)sums;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r *record = (peri_r *)o->records + k * m->record_reals + 2 * PERI_D;
        record[0] = response[i];
        if (!(m->gathers & PERI__GRADIENT)) continue;
        for (int q = 0; q < PERI_D * PERI_D; ++q) record[q] = response[(1 + q) * m->stride + i];
        record[PERI_D * PERI_D] = constant[PERI__STABILIZATION * m->stride + i];
    }
}

/* Asks for what a pass over the list wants of the point four places on: places are not met in the order in which memory lies. */
PERI_INLINE void PERI_FN(fetch_ahead)(const peri__operands *o, int64_t place) {
    const peri__model *m = o->model;
    if (!m->order || place + 4 >= m->points) return;
    const int64_t i = m->order[place + 4];
    PERI_PREFETCH(&m->start[i]);
    PERI_PREFETCH(&m->count[i]);
    if (o->alive) PERI_PREFETCH(&o->alive[i * m->words]);
    if (PERI_MUTUAL(m)) PERI_PREFETCH((const peri_r *)m->portion + i);
    for (int d = 0; d < PERI_D; ++d) PERI_PREFETCH((const peri_r *)o->f + d * m->stride + i);
}

/* Sums of which points take portions are kept for the block, and dealt out in the end: a product more after each row would cost time. */
static void PERI_FN(force_list)(const peri__operands *o, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__model *m = o->model;
    const int tensors = m->gathers & PERI__GRADIENT;
    peri_r shared[PERI_BLOCK][PERI_D];
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r *force = (peri_r *)o->f + i, *f = shared[k - begin];
        int by_row, counted = 0; /* the work on its bonds                                                                   */
        PERI_FN(fetch_ahead)(o, k);
        for (int d = 0; d < PERI_D; ++d) f[d] = PERI_MUTUAL(m) ? 0 : force[d * m->stride];
        if (PERI_FN(near_stress)(o, i) || PERI_FN(near_node_energy)(o, i)) by_row = 1;
        else if (o->fields && (PERI_FN(is_list_mixed)(m) || o->working)) by_row = 1;
        else if (o->fields && !tensors) by_row = PERI_BY_VECTORS(m, list_fielded)(o, k, f);
        else if (PERI_FN(is_list_mixed)(m)) counted = by_row = PERI_BY_VECTORS(m, list_mixed)(o, k, f);
        else if (m->pairwise) by_row = PERI_BY_VECTORS(m, list_pairwise)(o, k, f);
        else if (!tensors) by_row = PERI_BY_VECTORS(m, list_ordinary)(o, k, f);
        else if (o->central[i / peri__central_of(m)]) by_row = 1;
        else counted = by_row = PERI_BY_VECTORS(m, list_tensor)(o, k, f);
        if (by_row) {
            peri__operands rest = *o;
            if (counted) rest.working = 0;
            PERI_FN(force_rows)(&rest, i, i + 1, sums);
            for (int d = 0; d < PERI_D; ++d) f[d] = 0;
        } else if (!PERI_MUTUAL(m))
            for (int d = 0; d < PERI_D; ++d) force[d * m->stride] = f[d];
    }
    for (int64_t k = begin; PERI_MUTUAL(m) && k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        const peri_r portion = ((const peri_r *)m->portion)[i];
        for (int d = 0; d < PERI_D; ++d) ((peri_r *)o->f)[d * m->stride + i] += portion * shared[k - begin][d];
    }
}

/* What a point whose law has a gradient, n K^-1 of the sum n of w eta xi V, has of it per volume; H to h. */
static double PERI_FN(gradient_energy)(const peri__operands *o, int64_t i, peri_r n[PERI_D][PERI_D], peri_r h[PERI_D][PERI_D]) {
    peri__law room;
    peri_r strain[PERI_D][PERI_D];
    PERI_FN(gradient)(o, i, n, h);
    PERI_FN(strain)(PERI_D, o->linear, h, strain);
    if (o->eigenstrain) PERI_FN(make_elastic)(o, i, strain);
    return PERI_FN(strain_energy)(peri__stiffened(o->model, i, (double)PERI_FN(stiffness)(o, i), &room), PERI_D, strain);
}

/* The energy density of point i, of the sum w |eta - H xi|^2 V and what its gradient gives. Where it acts by central bonds rows tell. */
static double PERI_FN(whole_energy)(const peri__operands *o, int64_t i, double gradient, double misfit) {
    const peri__model *m = o->model;
    peri__row row;
    if (PERI_FN(constant)(o, PERI__SPRING, i) == 0)
        return gradient + 0.5 * (double)PERI_FN(constant)(o, PERI__STABILIZATION, i) * (misfit / peri__share(m, i));
    peri__row_of(m, i, &row);
    return PERI_FN(point_energy)(o, i, &row);
}

/* The energy density of a point of an ordinary law; squares: sum w e^2 V, sum: of w g e V, both with the share of the point. */
PERI_INLINE double PERI_FN(ordinary_energy)(const peri__operands *o, int64_t i, double squares, peri_r sum) {
    return 0.5 * (double)PERI_FN(constant)(o, PERI__SPRING, i) * (squares / peri__share(o->model, i))
         + 0.5 * (double)PERI_FN(constant)(o, PERI__PRESSURE_FACTOR, i) * (double)PERI_FN(constant)(o, PERI__THETA_FACTOR, i)
               * peri__square((double)(sum * PERI_FN(portion)(o->model, i)));
}

/* The energy of the node at a place; n: the sum of w eta xi V. */
static void PERI_FN(list_node)(const peri__operands *o, int64_t place, peri_r n[PERI_D][PERI_D]) {
    const peri__model *m = o->model;
    const int64_t i = peri__nth(m, place);
    double density;
    if (o->fields || m->mixed) {
        peri__row row;
        peri__row_of(m, i, &row);
        density = PERI_FN(point_energy)(o, i, &row);
    } else if (m->gathers & PERI__GRADIENT) {
        peri_r h[PERI_D][PERI_D];
        const double gradient = PERI_FN(gradient_energy)(o, i, n, h);
        density = PERI_FN(whole_energy)(o, i, gradient, PERI_BY_VECTORS(m, list_misfit)(o, place, h));
    } else
        density = PERI_FN(ordinary_energy)(o, i, PERI_BY_VECTORS(m, list_least)(o, place, 1),
                                           PERI_BY_VECTORS(m, list_dilatation_sum)(o, place));
    o->node[i] = 2.0 * density / peri__family_volume(m, i);
}

static void PERI_FN(gather_list)(const peri__operands *o, int64_t begin, int64_t end) {
    const peri__model *m = o->model;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r n[PERI_D][PERI_D];
        PERI_FN(fetch_ahead)(o, k);
        if (m->gathers & PERI__GRADIENT) {
            PERI_BY_VECTORS(m, list_shape)(o, k, n);
            PERI_FN(share_out)(m, i, n);
            PERI_FN(put_tensor)(o, i, n);
        } else
            PERI_FN(put_pressure)(o, i, PERI_FN(constant)(o, PERI__PRESSURE_FACTOR, i) == 0 ? 0 :
                                             PERI_BY_VECTORS(m, list_dilatation_sum)(o, k) * PERI_FN(portion)(m, i));
        if (o->node) PERI_FN(list_node)(o, k, n);
    }
}

/* ---- columns -------------------------------------------------------------------------------------------------------- */

/* The force on group g by columns; returns a bit for each point that must be done by rows. */
static uint32_t PERI_FN(group_force)(const peri__operands *o, int64_t g, peri_r f[PERI_D][PERI_GROUP]) {
    const peri__model *m = o->model;
    if (m->seen_by & PERI__BY_ROWS && o->breaking) return 0xFFFFu;
    uint32_t rows = 0;
    for (int l = 0; (o->nearness || o->node) && l < PERI_GROUP && g * PERI_GROUP + l < m->points; ++l) {
        const int64_t i = g * PERI_GROUP + l;
        rows |= (uint32_t)(PERI_FN(near_stress)(o, i) || PERI_FN(near_node_energy)(o, i)) << l;
    }
    if (o->fields) return rows | PERI_BY_VECTORS(m, fielded)(o, g, f);
    if (m->pairwise) return rows | PERI_BY_VECTORS(m, pairwise)(o, g, f);
    if (m->stencil.ends) return rows | PERI_BY_VECTORS(m, mixed)(o, g, f);
    if (!(m->gathers & PERI__GRADIENT)) return rows | PERI_BY_VECTORS(m, ordinary)(o, g, f);
    for (int l = 0; m->part && l < PERI_GROUP && g * PERI_GROUP + l < m->points; ++l)
        rows |= (uint32_t)o->central[g * PERI_GROUP + l] << l;
    return !m->part && o->central[g] ? 0xFFFFu : rows | PERI_BY_VECTORS(m, tensor)(o, g, f);
}

/* The points of group g whose bits are set are done by rows, the others get f. */
static void PERI_FN(finish_by_rows)(const peri__operands *o, int64_t g, uint32_t by_row, peri_r f[PERI_D][PERI_GROUP], peri__sums *sums) {
    const peri__model *m = o->model;
    const int64_t first = g * PERI_GROUP;
    peri_r *force = (peri_r *)o->f + first;
    peri__operands rest = *o;
    uint32_t broke = 0;
    if (!(m->seen_by & PERI__BY_ROWS && o->breaking)) rest.working = 0; /* that is done */
    for (int l = 0; l < PERI_GROUP && first + l < m->points; ++l) {
        const int64_t broken = sums->n;
        if (by_row >> l & 1) PERI_FN(force_rows)(&rest, first + l, first + l + 1, sums);
        else
            for (int d = 0; d < PERI_D; ++d) force[d * m->stride + l] = f[d][l];
        if (sums->n > broken) broke |= (uint32_t)1 << l;
    }
    if (broke && m->pairwise) peri__group_masks(m, g, broke, o->alive, o->masks);
}

static void PERI_FN(force_columns)(const peri__operands *o, int64_t g, peri__sums *sums) {
    const peri__model *m = o->model;
    const int64_t first = g * PERI_GROUP;
    peri_r *force = (peri_r *)o->f + first, f[PERI_D][PERI_GROUP];
    if (PERI_MUTUAL(m)) memset(f, 0, sizeof f);
    else
        for (int d = 0; d < PERI_D; ++d) memcpy(f[d], &force[d * m->stride], sizeof f[d]);
    const uint32_t by_row = PERI_FN(group_force)(o, g, f);
    for (int d = 0; PERI_MUTUAL(m) && d < PERI_D; ++d)
        PERI_BY_VECTORS(m, share_some)((const peri_r *)m->portion + first, &force[d * m->stride], f[d]);
    if (!by_row) {
        for (int d = 0; d < PERI_D; ++d) memcpy(&force[d * m->stride], f[d], sizeof f[d]);
        return;
    }
    PERI_FN(finish_by_rows)(o, g, by_row, f, sums);
}

/* The sums of w eta xi V, for criteria of stress: by the list, or by rows, */
static void PERI_FN(shape_list)(const peri__operands *o, int64_t begin, int64_t end) {
    const peri__model *m = o->model;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = m->record_reals ? peri__nth(m, k) : k;
        peri_r n[PERI_D][PERI_D];
        peri__row row;
        if (m->record_reals) {
            PERI_BY_VECTORS(m, list_shape)(o, k, n);
            PERI_FN(share_out)(m, i, n);
        } else {
            peri__row_of(m, i, &row);
            PERI_FN(row_shape)(o, i, &row, n);
        }
        for (int a = 0; a < PERI_D; ++a)
            for (int d = 0; d < PERI_D; ++d) o->stress[(i * PERI_D + a) * PERI_D + d] = (double)n[a][d];
    }
}

/* or by columns. */
static void PERI_FN(gather_shapes)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *o = (const peri__operands *)context;
    const peri__model *m = o->model;
    (void)sums;
    if (!m->stencil.columns) {
        PERI_FN(shape_list)(o, begin, end);
        return;
    }
    for (int64_t g = begin / PERI_GROUP; g * PERI_GROUP < end; ++g) {
        peri_r shape[PERI_D][PERI_D][PERI_GROUP];
        PERI_BY_VECTORS(m, shape)(o, g, shape);
        for (int64_t i = g * PERI_GROUP; i < peri__min((g + 1) * PERI_GROUP, m->points); ++i) {
            const peri_r portion = PERI_FN(portion)(m, i);
            for (int a = 0; a < PERI_D; ++a)
                for (int d = 0; d < PERI_D; ++d)
                    o->stress[(i * PERI_D + a) * PERI_D + d] = (double)(portion * shape[a][d][i - g * PERI_GROUP]);
        }
    }
}

/* The least stretch of points, 0 where no bond lives, for criteria. */
static void PERI_FN(gather_least)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *o = (const peri__operands *)context;
    const peri__model *m = o->model;
    double group[PERI_GROUP];
    (void)sums;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = m->record_reals ? peri__nth(m, k) : k;
        double least;
        if (m->stencil.columns && k % PERI_GROUP == 0) PERI_BY_VECTORS(m, least)(o, k / PERI_GROUP, group);
        if (m->stencil.columns) least = group[k % PERI_GROUP];
        else least = m->record_reals ? PERI_BY_VECTORS(m, list_least)(o, k, 0) : PERI_FN(row_least)(o, i);
        o->least[i] = least < HUGE_VAL ? least : 0.0;
    }
}

/* Energy densities of group g, of a law with gradients, */
static void PERI_FN(group_gradient_energy)(const peri__operands *o, int64_t g, double density[PERI_GROUP]) {
    const peri__model *m = o->model;
    peri_r shape[PERI_D][PERI_D][PERI_GROUP], whole[PERI_D][PERI_D][PERI_GROUP] = { { { 0 } } }, n[PERI_D][PERI_D], h[PERI_D][PERI_D];
    double misfit[PERI_GROUP];
    PERI_BY_VECTORS(m, shape)(o, g, shape);
    for (int l = 0; l < PERI_GROUP && g * PERI_GROUP + l < m->points; ++l) {
        for (int k = 0; k < PERI_D * PERI_D; ++k) n[k / PERI_D][k % PERI_D] = shape[k / PERI_D][k % PERI_D][l];
        PERI_FN(share_out)(m, g * PERI_GROUP + l, n);
        density[l] = PERI_FN(gradient_energy)(o, g * PERI_GROUP + l, n, h);
        for (int k = 0; k < PERI_D * PERI_D; ++k) whole[k / PERI_D][k % PERI_D][l] = h[k / PERI_D][k % PERI_D];
    }
    PERI_BY_VECTORS(m, misfit)(o, g, whole, misfit);
    for (int l = 0; l < PERI_GROUP && g * PERI_GROUP + l < m->points; ++l)
        density[l] = PERI_FN(whole_energy)(o, g * PERI_GROUP + l, density[l], misfit[l]);
}

/* or of any. */
static void PERI_FN(group_energy)(const peri__operands *o, int64_t g, double density[PERI_GROUP]) {
    const peri__model *m = o->model;
    peri_r sum[PERI_GROUP] = { 0 };
    if (m->gathers & PERI__GRADIENT) {
        PERI_FN(group_gradient_energy)(o, g, density);
        return;
    }
    PERI_BY_VECTORS(m, squares)(o, g, density);
    if (m->gathers & PERI__DILATATION) PERI_BY_VECTORS(m, dilatation_sum)(o, g, sum);
    for (int l = 0; l < PERI_GROUP && g * PERI_GROUP + l < m->points; ++l) {
        const int64_t i = g * PERI_GROUP + l;
        if (m->pairwise) density[l] = 0.25 * (density[l] / peri__share(m, i));
        else density[l] = PERI_FN(ordinary_energy)(o, i, density[l], sum[l]);
    }
}

/* Are energies had by columns? */
PERI_INLINE int PERI_FN(has_group_energy)(const peri__operands *o) {
    const peri__model *m = o->model;
    return m->stencil.columns > 0 && !m->mixed && !o->fields;
}

static void PERI_FN(gather_columns)(const peri__operands *o, int64_t g) {
    const peri__model *m = o->model;
    const int64_t first = g * PERI_GROUP, end = peri__min(first + PERI_GROUP, m->points);
    peri_r shape[PERI_D][PERI_D][PERI_GROUP], sum[PERI_GROUP], n[PERI_D][PERI_D];
    if (m->gathers & PERI__GRADIENT) {
        PERI_BY_VECTORS(m, shape)(o, g, shape);
        for (int64_t i = first; i < end; ++i) {
            if (!(m->laws[m->material[i]].gather & PERI__GRADIENT)) continue;
            for (int a = 0; a < PERI_D; ++a)
                for (int d = 0; d < PERI_D; ++d) n[a][d] = shape[a][d][i - first];
            PERI_FN(share_out)(m, i, n);
            PERI_FN(put_tensor)(o, i, n);
        }
    }
    if (!(m->gathers & PERI__DILATATION)) return;
    PERI_BY_VECTORS(m, dilatation_sum)(o, g, sum);
    for (int64_t i = first; i < end; ++i)
        if (!(m->laws[m->material[i]].gather & PERI__GRADIENT)) PERI_FN(put_pressure)(o, i, sum[i - first] * PERI_FN(portion)(m, i));
}

static void PERI_FN(gather_nodes)(const peri__operands *o, int64_t g) {
    const peri__model *m = o->model;
    const int64_t first = g * PERI_GROUP, end = peri__min(first + PERI_GROUP, m->points);
    double density[PERI_GROUP];
    peri__row row;
    if (PERI_FN(has_group_energy)(o)) PERI_FN(group_energy)(o, g, density);
    for (int64_t i = first; i < end; ++i) {
        if (!PERI_FN(has_group_energy)(o)) {
            peri__row_of(m, i, &row);
            density[i - first] = PERI_FN(point_energy)(o, i, &row);
        }
        o->node[i] = 2.0 * density[i - first] / peri__family_volume(m, i);
    }
}

/* ---- blocks --------------------------------------------------------------------------------------------------------- */

/* What points make of their families. */
static void PERI_FN(gather_block)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *o = (const peri__operands *)context;
    const peri__model *m = o->model;
    if (m->record_reals) PERI_FN(gather_list)(o, begin, end);
    else if (!m->stencil.columns) PERI_FN(gather_rows)(context, begin, end, sums);
    else
        for (int64_t g = begin / PERI_GROUP; g * PERI_GROUP < end; ++g) {
            PERI_FN(gather_columns)(o, g);
            if (o->node) PERI_FN(gather_nodes)(o, g);
        }
}

/* Adds the internal force density to f, and breaks bonds or notes in `dying` which are to break: see row_force. sums: a energy of bonds
   that broke, n their (directed) number, or that of those noted. */
static void PERI_FN(force_block)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *o = (const peri__operands *)context;
    const peri__model *m = o->model;
    if (m->record_reals) PERI_FN(force_list)(o, begin, end, sums);
    else if (!m->stencil.columns) PERI_FN(force_rows)(o, begin, end, sums);
    else
        for (int64_t g = begin / PERI_GROUP; g * PERI_GROUP < end; ++g) PERI_FN(force_columns)(o, g, sums);
}

/* Elastic energy of live bonds: sums->a, and per point to ->out where it is not NULL. By rows, too, of points that begin within a group. */
static void PERI_FN(energy)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__operands *o = (const peri__operands *)context;
    const peri__model *m = o->model;
    const int columns = PERI_FN(has_group_energy)(o) && begin % PERI_GROUP == 0;
    double group[PERI_GROUP];
    peri__row row;
    for (int64_t i = begin; i < end; ++i) {
        if (columns && i % PERI_GROUP == 0) PERI_FN(group_energy)(o, i / PERI_GROUP, group);
        if (!columns) peri__row_of(m, i, &row);
        const double density = columns ? group[i % PERI_GROUP] : PERI_FN(point_energy)(o, i, &row);
        if (o->out) o->out[i] = density;
        if (!o->ghost || !o->ghost[i]) sums->a += density * m->volume[i];
    }
}
