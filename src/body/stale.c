/* SPDX-License-Identifier: MIT */
/* stale.c - what a change makes stale, and how that is brought up to date: the one place that knows.

   Who changes a body calls peri__changed, who reads what is derived calls peri__ensure. A change costs no more than bits, so that a hundred
   cuts between two steps cost one pass over the bonds; but before the first change by the caller the ledger notes the energy. The steps of
   explicit.c and the rounds of failure.c keep masks, constants and force up to date as they go, and set no bits. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef enum peri__change {
    PERI__MOTION, /* displacement or velocity, by the caller                                                             */
    PERI__CUTS,   /* bonds, by the caller                                                                                */
    PERI__EIGENSTRAIN, /* by the caller                                                                                 */
    PERI__STIFFNESS, /* or density, by the caller                                                                        */
    PERI__BONDS,  /* bonds that a criterion broke or peri_reset mended: the ledger has an account of its own for them    */
    PERI__ACTION  /* loads, supports, obstacles, the load factor; or a step that ended half way                          */
} peri__change;

static double peri__whole_energy(peri_body *b) {
    if (b->contact) (void)peri__ready_contact(b);
    return peri__kinetic_energy(b) + peri__elastic_energy(b, NULL) + peri__contact_energy(b);
}

/* Before displacement, velocity or bonds are changed by the caller, not by the equations of motion: the change of energy counts as
   `initial`. It is measured when next needed, so that a hundred cuts cost two energy passes. Fails where a law of bonds does: that must
   not be changed then of which the energy is not known. */
static int32_t peri__note_energy(peri_body *b) {
    peri__ledger *l = &b->now.ledger;
    if (!b->desc.ledger || b->now.stale & PERI__STALE_LEDGER) return PERI_OK;
    const double before = b->now.steps == 0 && l->initial == 0.0 ? 0.0 : peri__whole_energy(b);
    const int32_t status = peri__heed_laws(b);
    if (status < 0) return status;
    l->before = before;
    b->now.stale |= PERI__STALE_LEDGER;
    return PERI_OK;
}

/* After any change but those below, or before it. */
static void peri__changed(peri_body *b, peri__change what) {
    if ((what == PERI__CUTS || what == PERI__STIFFNESS) && b->kept) {
        if (b->running) b->kept->ready = b->kept->preconditioner = 0; /* a solve is at work with it */
        else peri__forget_solver(b);
    }
    if (what == PERI__CUTS || what == PERI__BONDS) b->now.stale |= PERI__STALE_MASKS;
    if ((what == PERI__CUTS || what == PERI__BONDS) && !b->model->pairwise) b->now.stale |= PERI__STALE_CONSTANTS;
    if (what == PERI__STIFFNESS) b->now.stale |= PERI__STALE_SHARP | (b->model->pairwise ? 0u : (uint32_t)PERI__STALE_CONSTANTS);
    if ((what == PERI__CUTS && b->now.steps == 0) || ((what == PERI__CUTS || what == PERI__BONDS) && !b->softens))
        b->now.stale |= PERI__STALE_SHARP; /* initial cracks, of which a body that softens knows, come before the first step */
    if ((what == PERI__CUTS || what == PERI__BONDS) && b->contact) b->contact->dead = -1;
    if ((what == PERI__CUTS || what == PERI__BONDS) && b->seat) b->seat->dead = -1;
    peri__rouse(b->seat);
    b->now.stale |= PERI__STALE_FORCE | PERI__STALE_BALANCE;
    if (what == PERI__MOTION) b->now.stale |= PERI__STALE_STRETCH;
    if ((what == PERI__MOTION || what == PERI__CUTS) && b->model->inelastic) b->now.stale |= PERI__STALE_PAST;
}

/* Before a change by the caller of what stores energy; it is not made where this fails. */
static int32_t peri__alter(peri_body *b, peri__change what) {
    const int32_t status = peri__note_energy(b);
    if (status == PERI_OK) peri__changed(b, what);
    return status;
}

/* The forces of contact at no step. In equilibria nothing slips and nothing approaches. */
static int32_t peri__touch_now(peri_body *b) {
    if (!b->contact) return PERI_OK;
    if (!peri__ready_contact(b)) return peri__fail(b, PERI_ERROR_MEMORY, "contact", -1, 0.0);
    peri__apply_touch(b, 0.0, !b->now.still);
    return PERI_OK;
}

/* Likewise those of contact with other bodies, where the world that they share advances. */
static int32_t peri__touch_others_now(peri_body *b) {
    if (!b->seat || !b->seat->world->running) return PERI_OK;
    if (!peri__ready_world(b->seat->world)) return peri__fail(b, PERI_ERROR_MEMORY, "peri_world", -1, 0.0);
    (void)peri__press_world(b->seat->world);
    peri__push_body(b->seat, 0.0);
    return PERI_OK;
}

/* f of u, loads and bonds as they are, without breaking anything. */
static int32_t peri__make_force(peri_body *b) {
    peri__operands operands = peri__operands_of(b);
    const peri__model *m = b->model;
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    b->law_bad = -1;
    memset(b->f, 0, (size_t)(m->stride * m->dim) * peri__real(b));
    b->now.pushed = 0;
    int32_t status = peri__share_ghosts(b);
    if (status == PERI_OK) status = peri__apply_loads(b, peri__load_time(b), 0.0);
    if (status == PERI_OK) status = peri__apply_obstacles(b, peri__load_time(b), 0.0);
    if (status == PERI_OK) {
        operands.working = m->seen_by & PERI__BY_WORK;
        operands.past.commit = b->past.settling;
        peri__bond_forces(b, &operands);
        status = peri__heed_laws(b);
        if (status == PERI_OK) status = peri__touch_now(b);
        if (status == PERI_OK) status = peri__touch_others_now(b);
        if (status == PERI_OK) status = peri__meet_supports(b);
    }
    peri__leave(b, former);
    return status;
}

/* Brings up to date what is stale of `what`, bits of peri__stale, and what that is made of. Fails only where a load, an obstacle or a law
   of bonds does, or where contact has no memory; what was asked for then stays stale. */
static int32_t peri__ensure(peri_body *b, uint32_t what) {
    what &= b->now.stale;
    if (what & (PERI__STALE_FORCE | PERI__STALE_MASKS)) peri__update_masks(b);
    if (what & (PERI__STALE_FORCE | PERI__STALE_CONSTANTS)) peri__refresh(b);
    if (what & PERI__STALE_FORCE) {
        int32_t status = peri__make_force(b);
        if (status < 0) return status;
    }
    if (what & PERI__STALE_LEDGER) {
        const double put_in = peri__whole_energy(b) - b->now.ledger.before;
        const int32_t status = peri__heed_laws(b);
        if (status < 0) return status;
        b->now.ledger.initial += put_in;
    }
    b->now.stale &= ~what;
    return PERI_OK;
}

/* Before a run or a solve: what the caller's change of the motion, or of the bonds, makes of inelastic materials, in no time; its energy is
   put in by the caller. */
static int32_t peri__settle_past(peri_body *b) {
    if (!(b->now.stale & PERI__STALE_PAST)) return PERI_OK;
    b->now.stale |= PERI__STALE_FORCE; /* whoever has read it in the meantime */
    b->past.settling = 1;
    const int32_t status = peri__ensure(b, PERI__STALE_FORCE);
    b->past.settling = 0;
    if (status == PERI_OK) b->now.stale &= ~(uint32_t)PERI__STALE_PAST;
    return status;
}

/* For those who read forces: within a step they are those under way. */
static int32_t peri__ensure_force(peri_body *b) {
    return b->running > PERI__IN_FRAME ? PERI_OK : peri__ensure(b, PERI__STALE_FORCE);
}
