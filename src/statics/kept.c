/* SPDX-License-Identifier: MIT */
/* kept.c - what a solve leaves to the next: levels and blocks of the preconditioner, until bonds or supports are others.

   They are compared with copies, not marked stale: bonds are broken, cut, mended and loaded in many places. Only another stiffness of bonds
   is told, by peri__changed. Loads and prescribed values are free to change: nothing that is kept knows of them. Where parts float, points
   are singular or the tangent goes with the displacements, only the levels are kept. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Takes over what the body keeps, or begins to keep. 0: the settings do not ask for it, or memory is short. */
static int peri__take_kept(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    if (!s->settings->keep || s->settings->method != PERI_METHOD_NEWTON) {
        peri__forget_solver(b);
        return 0;
    }
    const peri__memory memory = peri__lasting(b);
    const int64_t blocks = PERI_PACKED(m->dim) * m->stride;
    if (!b->kept) {
        peri__kept *kept = (peri__kept *)peri__new(&memory, 1, sizeof *kept);
        if (kept) kept->blocks = peri__new(&memory, blocks, peri__real(b));
        if (kept) kept->axes = (uint8_t *)peri__new(&memory, m->points, 1);
        if (!kept || !kept->blocks || !kept->axes) {
            peri__forget_solver(b);
            return 0;
        }
        b->kept = kept;
    }
    s->kept = b->kept;
    s->levels = s->kept->levels;
    s->pace = s->kept->pace;
    s->lost = s->kept->lost;
    s->bytes += blocks * (int64_t)peri__real(b) + m->points + (s->levels ? s->levels->bytes : 0);
    if (s->kept->alive) s->bytes += m->points * m->words * (int64_t)sizeof *s->kept->alive;
    return 1;
}

/* Are bonds, supports (in s->constrained) and the choice of preconditioner those of what is kept? If not it is no more ready. */
static int peri__is_as_kept(peri__solver *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    peri__kept *kept = s->kept;
    const uint8_t axes = (uint8_t)((1 << m->dim) - 1);
    if (!kept) return 0;
    int same = kept->preconditioner == s->settings->preconditioner && (kept->alive != NULL) == (b->alive != NULL);
    for (int64_t i = 0; same && i < m->points; ++i) same = kept->axes[i] == (s->constrained[i] & axes);
    if (same && b->alive) same = memcmp(kept->alive, b->alive, (size_t)(m->points * m->words) * sizeof *b->alive) == 0;
    kept->ready = kept->ready && same && peri__is_linear(b);
    if (!same) kept->preconditioner = 0; /* of no choice, until all is made anew */
    for (int64_t i = 0; i < m->points; ++i) kept->axes[i] = s->constrained[i] & axes; /* before more than supports is held */
    return same;
}

/* The solver as it was prepared when all was kept. */
static int32_t peri__recall(peri__solver *s) {
    for (int64_t i = 0; i < s->body->model->points; ++i) s->part_of[i] = PERI_HELD;
    s->stiff = s->kept->stiff;
    s->softest = s->kept->softest;
    s->part_count = s->singular = 0;
    s->report.loose = s->report.lost_parts = s->report.lost_points = 0;
    peri__note_bytes(s);
    return PERI_OK;
}

/* What has been prepared is kept. */
static int32_t peri__keep_solver(peri__solver *s) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    peri__kept *kept = s->kept;
    if (!kept) return PERI_OK;
    if (b->alive && !kept->alive) {
        const peri__memory memory = peri__lasting(b);
        kept->alive = (uint32_t *)peri__new(&memory, m->points * m->words, sizeof *kept->alive);
        if (!kept->alive) return peri__fail(b, PERI_ERROR_MEMORY, "peri_solve", -1, 0.0);
        s->bytes += m->points * m->words * (int64_t)sizeof *kept->alive;
        peri__note_bytes(s);
    }
    if (b->alive) memcpy(kept->alive, b->alive, (size_t)(m->points * m->words) * sizeof *b->alive);
    kept->preconditioner = s->settings->preconditioner;
    kept->stiff = s->stiff;
    kept->softest = s->softest;
    kept->ready = peri__is_linear(b) && s->report.loose == 0 && s->report.lost_points == 0 && s->singular == 0;
    return PERI_OK;
}
