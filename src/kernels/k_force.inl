/* k_force.inl - the pass that adds bond forces and breaks bonds: on columns where there are any, else on the list or by rows; and what goes
   before it on the list. */

/* Records of k_list.inl. */
static void PERI_FN(pack)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = ((const peri__step *)context)->body;
    const peri__model *m = b->model;
    const peri_r *x = (const peri_r *)m->x, *u = (const peri_r *)b->u;
    const peri_b *p = m->ordinary ? (const peri_b *)b->response + m->margin : NULL;
    const peri_b *q = m->ordinary ? (const peri_b *)b->constant + m->margin + PERI__SPRING * m->stride : NULL;
    (void)sums;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r *record = (peri_r *)b->pack + k * m->slots;
        for (int d = 0; d < PERI_D; ++d) {
            record[d] = x[d * m->stride + i];
            record[PERI_D + d] = u[d * m->stride + i];
        }
        if (m->ordinary) {
            record[2 * PERI_D] = p[i];
            record[2 * PERI_D + 1] = q[i];
        } else if (!m->states && m->slots > 2 * PERI_D)
            record[2 * PERI_D] = (peri_r)m->material[i];
    }
}

/* And what points respond with: p, or Q and k. */
static void PERI_FN(pack_response)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = ((const peri__step *)context)->body;
    const peri__model *m = b->model;
    const peri_b *response = (const peri_b *)b->response + m->margin, *constant = (const peri_b *)b->constant + m->margin;
    (void)sums;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r *record = (peri_r *)b->pack + k * m->slots + 2 * PERI_D;
        record[0] = response[i];
        if (!m->tensors) continue;
        for (int q = 0; q < PERI_D * PERI_D; ++q) record[q] = response[(1 + q) * m->stride + i];
        record[PERI_D * PERI_D] = constant[PERI__VECTOR * m->stride + i];
    }
}

/* Rows [begin, end), one by one. */
static void PERI_FN(force_rows)(const peri__step *step, int64_t begin, int64_t end, peri__sums *sums) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    peri_r *force = (peri_r *)b->f, *v = (peri_r *)b->v;
    int linear = b->desc.geometry == PERI_LINEAR, plain = b->desc.kernel == PERI_KERNEL_REFERENCE || m->centroid != NULL;
    peri__row row;
    for (int64_t i = begin; i < end; ++i) {
        peri_r f[PERI_D], impulse[PERI_D];
        int32_t broke;
        peri__read_row(b, i, &row);
        for (int d = 0; d < PERI_D; ++d) {
            f[d] = force[d * m->stride + i];
            impulse[d] = 0;
        }
        if (plain) broke = PERI_FN(bond_row_reference)(step, i, &row, f, impulse, &sums->a);
        else if (b->alive) broke = PERI_FN(bond_row)(step, i, &row, f, impulse, &sums->a, 1, linear);
        else broke = PERI_FN(bond_row)(step, i, &row, f, impulse, &sums->a, 0, linear);
        for (int d = 0; d < PERI_D; ++d) force[d * m->stride + i] = f[d];
        if (broke) {
            peri_r kick = (peri_r)(step->impulse / m->rho[m->material[i]]);
            for (int d = 0; d < PERI_D; ++d) v[d * m->stride + i] += kick * impulse[d];
            sums->n += broke;
        }
    }
}

/* Group g by columns; points of it by rows where a bond is about to break. */
static void PERI_FN(force_group)(const peri__step *step, int64_t g, peri__sums *sums) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    const int64_t first = g * PERI_LANES;
    uint32_t broke = 0;
    peri_r *force = (peri_r *)b->f + first, f[PERI_D][PERI_LANES];
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) f[d][l] = force[d * m->stride + l];
    const uint32_t hit = PERI_ON_LANES(m->lanes.isa, lanes, (step, g, f));
    if (!hit) {
        for (int d = 0; d < PERI_D; ++d)
            for (int l = 0; l < PERI_LANES; ++l) force[d * m->stride + l] = f[d][l];
        return;
    }
    for (int l = 0; l < PERI_LANES; ++l) {
        const int64_t broken = sums->n;
        if (hit >> l & 1) PERI_FN(force_rows)(step, first + l, first + l + 1, sums);
        else
            for (int d = 0; d < PERI_D; ++d) force[d * m->stride + l] = f[d][l];
        if (sums->n > broken) broke |= (uint32_t)1 << l;
    }
    if (broke) peri__group_masks(m, g, broke, b->alive, b->lanes_alive);
}

/* Asks for what a pass over the list wants of the point four places on: places are not met in the order in which memory lies. */
PERI_INLINE void PERI_FN(fetch_ahead)(const peri_body *b, int64_t place) {
    const peri__model *m = b->model;
    if (!m->order || place + 4 >= m->points) return;
    const int64_t i = m->order[place + 4];
    PERI_PREFETCH(&m->start[i]);
    PERI_PREFETCH(&m->count[i]);
    if (b->alive) PERI_PREFETCH(&b->alive[i * m->words]);
    for (int d = 0; d < PERI_D; ++d) PERI_PREFETCH((const peri_r *)b->f + d * m->stride + i);
}

/* Rows by the list, or one by one where a bond is about to break. */
static void PERI_FN(force_list)(const peri__step *step, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__model *m = step->body->model;
    peri_r *force = (peri_r *)step->body->f;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        peri_r f[PERI_D];
        PERI_FN(fetch_ahead)(step->body, k);
        for (int d = 0; d < PERI_D; ++d) f[d] = force[d * m->stride + i];
        if (PERI_ON_LANES(m->lanes.isa, list_force, (step, k, f))) PERI_FN(force_rows)(step, i, i + 1, sums);
        else
            for (int d = 0; d < PERI_D; ++d) force[d * m->stride + i] = f[d];
    }
}

/* Adds the internal force density to f and breaks bonds. sums: a energy of broken bonds, n their (directed) number. */
static void PERI_FN(force)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__step *step = (const peri__step *)context;
    if (step->body->model->slots) PERI_FN(force_list)(step, begin, end, sums);
    else if (!step->body->model->lanes.columns) PERI_FN(force_rows)(step, begin, end, sums);
    else
        for (int64_t g = begin / PERI_LANES; g * PERI_LANES < end; ++g) PERI_FN(force_group)(step, g, sums);
}
