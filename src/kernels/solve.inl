/* SPDX-License-Identifier: MIT */
/* solve.inl - the static solver's work on whole vectors. */

/* d += alpha p, r -= alpha q. sums: |r|^2 of free dofs to a, of constrained ones to b. */
static void PERI_FN(krylov_step)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->model;
    double free_sum[PERI_BLOCK] = { 0.0 }, constrained_sum[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const int64_t at = d * m->stride + begin;
        peri_r *x = (peri_r *)s->d + at, *r = (peri_r *)s->r + at;
        const peri_r *p = (const peri_r *)s->p + at, *q = (const peri_r *)s->q + at;
        PERI_BY_VECTORS(m, step_some)(end - begin, (peri_r)s->alpha, p, q, x, r);
        PERI_BY_VECTORS(m, square_some)(end - begin, d, s->constrained + begin, r, free_sum, constrained_sum);
    }
    sums->a += peri__add_up(free_sum);
    sums->b += peri__add_up(constrained_sum);
}

/* p = z + beta p on free dofs, 0 on constrained ones. */
static void PERI_FN(krylov_turn)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->model;
    (void)sums;
    for (int d = 0; d < PERI_D; ++d) {
        peri_r *p = (peri_r *)s->p + d * m->stride + begin;
        const peri_r *z = (const peri_r *)s->z + d * m->stride + begin;
        PERI_BY_VECTORS(m, turn_some)(end - begin, d, s->constrained + begin, (peri_r)s->beta, z, p);
    }
}

/* q = -V q: the force that the change p of displacements needs. sums: p.q to a, p.p to b. */
static void PERI_FN(krylov_force)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->model;
    double bent[PERI_BLOCK] = { 0.0 }, square[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *p = (const peri_r *)s->p + d * m->stride + begin;
        peri_r *q = (peri_r *)s->q + d * m->stride + begin;
        PERI_BY_VECTORS(m, weigh_some)(end - begin, m->volume + begin, p, q, bent, square);
    }
    sums->a += peri__add_up(bent);
    sums->b += peri__add_up(square);
}

/* z = inverse blocks times r (0 for constrained dofs, whose rows are 0), or r itself. */
static void PERI_FN(krylov_blocks)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const int64_t stride = s->model->stride;
    const peri_r *blocks = (const peri_r *)s->blocks, *r = (const peri_r *)s->r;
    (void)sums;
    for (int a = 0; a < PERI_D; ++a) {
        peri_r *z = (peri_r *)s->z + a * stride;
        for (int64_t i = begin; i < end; ++i) {
            peri_r sum = 0;
            for (int c = 0; blocks && c < PERI_D; ++c) sum += blocks[peri__packed(PERI_D, a, c) * stride + i] * r[c * stride + i];
            z[i] = blocks ? sum : s->constrained[i] >> a & 1 ? 0 : r[a * stride + i];
        }
    }
}

/* sums: |r|^2 of free dofs to a, of constrained ones to b. */
static void PERI_FN(krylov_norm)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->model;
    double free_sum[PERI_BLOCK] = { 0.0 }, constrained_sum[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *r = (const peri_r *)s->r + d * m->stride + begin;
        PERI_BY_VECTORS(m, square_some)(end - begin, d, s->constrained + begin, r, free_sum, constrained_sum);
    }
    sums->a += peri__add_up(free_sum);
    sums->b += peri__add_up(constrained_sum);
}

/* sums: r.z over free dofs to a. */
static void PERI_FN(krylov_dot)(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__krylov *s = (const peri__krylov *)context;
    const peri__model *m = s->model;
    double sum[PERI_BLOCK] = { 0.0 };
    for (int d = 0; d < PERI_D; ++d) {
        const peri_r *r = (const peri_r *)s->r + d * m->stride + begin, *z = (const peri_r *)s->z + d * m->stride + begin;
        PERI_BY_VECTORS(m, dot_some)(end - begin, d, s->constrained + begin, r, z, sum);
    }
    sums->a += peri__add_up(sum);
}
