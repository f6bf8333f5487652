/* k_force.inl - the pass that adds bond forces and breaks bonds: on columns where there are any, else by rows. */

/* Rows [begin, end), one by one. */
static void PERI_FN(force_rows)(const peri__step *step, int64_t begin, int64_t end, peri__sums *sums) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    peri_r *force = (peri_r *)b->f, *v = (peri_r *)b->v;
    int linear = b->desc.geometry == PERI_LINEAR, plain = b->desc.reference || m->centroid != NULL;
    peri__row row;
    for (int64_t i = begin; i < end; ++i) {
        peri_r f[PERI_D], impulse[PERI_D];
        int32_t broke;
        peri__read_row(m, b->f32, i, &row);
        for (int d = 0; d < PERI_D; ++d) {
            f[d] = force[d * m->stride + i];
            impulse[d] = 0;
        }
        if (plain) broke = PERI_FN(bond_row_reference)(step, i, &row, f, impulse, &sums->a);
        else if (!b->alive)
            broke = linear ? PERI_FN(bond_row)(step, i, &row, f, impulse, &sums->a, 0, 1)
                           : PERI_FN(bond_row)(step, i, &row, f, impulse, &sums->a, 0, 0);
        else
            broke = linear ? PERI_FN(bond_row)(step, i, &row, f, impulse, &sums->a, 1, 1)
                           : PERI_FN(bond_row)(step, i, &row, f, impulse, &sums->a, 1, 0);
        for (int d = 0; d < PERI_D; ++d) force[d * m->stride + i] = f[d];
        if (broke) {
            peri_r kick = (peri_r)(step->impulse / m->rho[m->material[i]]);
            for (int d = 0; d < PERI_D; ++d) v[d * m->stride + i] += kick * impulse[d];
            sums->n += broke;
        }
    }
}

/* Group g by columns; by rows where a bond is about to break. */
static void PERI_FN(force_group)(const peri__step *step, int64_t g, peri__sums *sums) {
    peri_body *b = step->body;
    const peri__model *m = b->model;
    peri_r *force = (peri_r *)b->f + g * PERI_LANES, f[PERI_D][PERI_LANES];
    int64_t broken = sums->n;
    int near_breaking;
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) f[d][l] = force[d * m->stride + l];
    near_breaking = PERI_ON_LANES(m->lanes.isa, lanes, (step, g, f));
    if (near_breaking) {
        PERI_FN(force_rows)(step, g * PERI_LANES, peri__min((g + 1) * PERI_LANES, m->points), sums);
        if (sums->n > broken) peri__group_masks(m, g, b->alive, b->lanes_alive);
        return;
    }
    for (int d = 0; d < PERI_D; ++d)
        for (int l = 0; l < PERI_LANES; ++l) force[d * m->stride + l] = f[d][l];
}

/* Adds the internal force density to f and breaks bonds. sums: a energy of broken bonds, n their (directed) number. */
static void PERI_FN(force)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__step *step = (const peri__step *)context;
    if (!step->body->model->lanes.columns) PERI_FN(force_rows)(step, begin, end, sums);
    else
        for (int64_t g = begin / PERI_LANES; g * PERI_LANES < end; ++g) PERI_FN(force_group)(step, g, sums);
}
