/* SPDX-License-Identifier: MIT */
/* step.c - one equilibrium of a solve, with its place in the ledger, in the curve and before the callback. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* ---- the ledger --------------------------------------------------------------------------------------------------- */

/* The force density of loads and supports at this equilibrium, to `load`; with the one before and the way since then, their work. Where
   eigenstrain was changed before the first, that is the force that would hold the body: what is released on the way is work of the
   eigenstrain. */
static void peri__count_work(peri__solver *s, const void *from) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    const int unbalanced = b->eigenstrain != NULL;
    double work = 0.0;
    for (int32_t d = 0; s->load && d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            int64_t at = d * m->stride + i;
            double outer = peri__get_real(s->k.z, b->f32, at), way;
            if (s->constrained[i] >> d & 1 || (unbalanced && !from)) outer -= peri__get_real(b->f, b->f32, at);
            way = from ? peri__get_real(b->u, b->f32, at) - peri__get_real(from, b->f32, at) : 0.0;
            work += 0.5 * (outer + peri__get_real(s->load, b->f32, at)) * way * m->volume[i];
            peri__put_real(s->load, b->f32, at, outer);
        }
    b->now.ledger.external += work;
}

static double peri__static_energy(peri_body *b) {
    if (!b->desc.ledger) return 0.0;
    if (b->contact) (void)peri__ready_contact(b);
    return peri__elastic_energy(b, NULL) + peri__contact_energy(b);
}

static int32_t peri__static_values(peri_body *b) {
    for (int64_t l = 0; l < b->load_count; ++l)
        if (b->loads[l].kind == PERI__DISPLACEMENT) {
            int32_t status = peri__refresh_load(b, &b->loads[l], b->now.load_factor);
            if (status < 0) return status;
        }
    return PERI_OK;
}

/* What loads and supports do to the body as it stands, for the ledger. */
static int32_t peri__note_forces(peri__solver *s) {
    peri_body *b = s->body;
    int32_t status = peri__static_values(b);
    if (status < 0) return status;
    memset(s->constrained, 0, (size_t)b->model->points);
    s->part_count = s->singular = 0;
    (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    double loads = peri__static_forces(s);
    if (loads < 0.0) return (int32_t)loads;
    peri__mark_supports(s);
    peri__count_work(s, NULL);
    return PERI_OK;
}

/* Takes the velocities, once: not before the first solve is known to be possible. */
static void peri__stand_still(peri__solver *s) {
    peri_body *b = s->body;
    if (s->begun) return;
    s->begun = 1;
    b->now.loaded = 1;
    if (b->desc.ledger) b->now.ledger.damping += peri__kinetic_energy(b);
    memset(b->v, 0, peri__vector_bytes(b));
}

/* From here on all acts with this load factor. */
static int32_t peri__set_factor(peri__solver *s, double factor) {
    peri_body *b = s->body;
    b->now.load_factor = factor;
    peri__changed(b, PERI__ACTION);
    int32_t status = peri__static_values(b);
    return status == PERI_OK ? peri__move_obstacles(b, factor, 0.0) : status;
}

typedef enum peri__afresh { /* what an equilibrium makes of supports, parts and preconditioner                        */
    PERI__AS_PREPARED, /* nothing: the bonds are the same, and the body is linear                                        */
    PERI__AFTER_BREAK, /* all but the coarse grids, to which the bonds that broke since matter little                    */
    PERI__ANEW
} peri__afresh;

/* Equilibrium at the present load factor and of the bonds that are left. */
static int32_t peri__equilibrium(peri__solver *s, peri__afresh afresh) {
    peri_body *b = s->body;
    int32_t status = PERI_OK;
    if (afresh != PERI__AS_PREPARED || !peri__is_linear(b)) status = peri__prepare(s, afresh == PERI__ANEW);
    if (status != PERI_OK) return status;
    peri__stand_still(s);
    s->left = s->settings->iterations;
    s->energy0 = 0.0;
    peri__note_strained(s);
    status = s->settings->method == PERI_METHOD_RELAXATION ? peri__relax(s) : peri__newton(s);
    if (status == PERI_OK && (b->model->seen_by & PERI__BY_WORK || b->model->inelastic)) {
        peri__operands operands = peri__operands_of(b);
        operands.working = (b->model->seen_by & PERI__BY_WORK) != 0;
        operands.past.commit = b->model->inelastic != 0;
        operands.step = s->t.step;
        operands.f = s->k.q; /* b->f stays that of the equilibrium */
        peri__bond_forces(b, &operands);
        status = peri__heed_laws(b);
    }
    if (status == PERI_OK) {
        b->now.time += s->t.step * b->model->time;
        s->t.step = 0.0; /* what breaks takes no time */
    }
    return status;
}

/* again: 1: in place of the last row, which was of the same factor, before on_step cut bonds. */
static int32_t peri__record(peri__solver *s, int again) {
    peri_body *b = s->body;
    const peri_solve_desc *st = s->settings;
    const int32_t dim = b->dim;
    double force[3];
    const int64_t curve = PERI_ID_INDEX(st->curve_load) - 1;
    if (st->curve_load == 0 || b->loads[curve].kind == PERI__FREE) return PERI_OK;
    int32_t status = peri__read_reaction_of(b, curve, force);
    if (status < 0) return status;
    if (s->report.curve_rows - again < st->curve_rows) {
        double *row = &st->curve[(s->report.curve_rows - again) * (2 + 2 * dim)];
        const peri__load *load = &b->loads[curve];
        row[0] = b->now.load_factor;
        for (int32_t d = 0; d < dim; ++d) {
            row[1 + d] = 0.0;
            for (int64_t k = 0; k < load->count; ++k) row[1 + d] += peri__get_real(b->u, b->f32, peri__dof(b, load, k, d));
            row[1 + d] *= b->model->length / (double)load->count;
            row[1 + dim + d] = force[d];
        }
        row[1 + 2 * dim] = (double)(b->now.broken / 2);
    }
    s->report.curve_rows += !again;
    return PERI_OK;
}

/* Reactions, the record and the callback at an equilibrium; again: 1: of the same step, after on_step cut bonds. */
static int32_t peri__show_step(peri__solver *s, int again) {
    peri_body *b = s->body;
    const int64_t broken = b->now.broken;
    b->now.steps += !again;
    s->report.steps += !again;
    s->cut = 0;
    s->report.load_factor = b->now.load_factor;
    if (s->from) memcpy(s->from, b->u, peri__vector_bytes(b)); /* the way here has been accounted for */
    for (int64_t l = 0; l < b->load_count; ++l) b->loads[l].stepped = 0;
    int32_t status = peri__meet_supports(b);
    if (status == PERI_OK) b->now.stale &= ~(uint32_t)(PERI__STALE_FORCE | PERI__STALE_BALANCE); /* f is that of the equilibrium */
    if (status == PERI_OK) status = peri__record(s, again);
    if (status == PERI_OK && b->break_said < 0) status = peri__heed_callbacks(b);
    if (status != PERI_OK || !s->settings->on_step) return status;
    const int32_t former = peri__enter(b, PERI__IN_FRAME);
    const int32_t said = peri__heed(b, s->settings->on_step(s->settings->user, b), "peri_frame_fn");
    peri__leave(b, former);
    status = peri__ensure(b, PERI__STALE_LEDGER);
    s->disturbed = b->desc.ledger && b->now.stale & PERI__STALE_BALANCE;
    s->cut = b->now.broken != broken;
    if (s->disturbed && said >= 0 && status == PERI_OK) status = peri__note_forces(s);
    return status < 0 ? status : said;
}
