/* SPDX-License-Identifier: MIT */
/* statics.c - load steps and quasi-static fracture: equilibrium at a load factor, bonds over their limit broken, equilibrium again, until
   none is; then the next load factor. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_ROUGH 1e-6 /* tolerance while bonds break                                                                   */
#define PERI_COOKIE_STATICS (UINT64_C(0x7065726900040000) + sizeof(peri_solve_desc))

PERI_API void peri_solve_desc_init(peri_solve_desc *st) {
    if (!st) return;
    memset(st, 0, sizeof *st);
    st->cookie = PERI_COOKIE_STATICS;
    st->method = PERI_METHOD_NEWTON;
    st->preconditioner = PERI_PRECONDITIONER_MULTILEVEL;
    st->loose = PERI_LOOSE_REFUSED;
    st->fracture = 1;
    st->control = PERI_CONTROL_LOAD;
    st->criticality = 0.98;
    st->iterations = 20000;
    st->newton = 60;
    st->breaks = 100000;
    st->load_to = 1.0;
    st->steps = 1;
    st->halvings = 8;
    st->load_from = (double)NAN;
}

static int32_t peri__check_statics(peri_body *b, const peri_solve_desc *st) {
    PERI_NEED(b, st, "desc");
    if (st->cookie != PERI_COOKIE_STATICS) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_CHOICE(b, method, st->method);
    PERI_NEED_CHOICE(b, preconditioner, st->preconditioner);
    PERI_NEED_CHOICE(b, loose, st->loose);
    PERI_NEED_FLAG(b, st->fracture);
    PERI_NEED_FLAG(b, st->keep);
    PERI_NEED_CHOICE(b, control, st->control);
    PERI_NEED_NUMBER(b, st->criticality >= 0.0 && st->criticality <= 1.0, st->criticality);
    PERI_NEED_NUMBER(b, st->criticality > 0.0 || st->control == PERI_CONTROL_LOAD, st->criticality);
    PERI_NEED_NUMBER(b, st->tolerance >= 0.0 && st->tolerance < 1.0, st->tolerance);
    PERI_NEED_NUMBER(b, st->energy_tolerance >= 0.0 && st->energy_tolerance < 1.0, st->energy_tolerance);
    if (!peri__is_nan(st->load_from)) PERI_NEED_NUMBER(b, 1, st->load_from);
    PERI_NEED_NUMBER(b, 1, st->load_to);
    PERI_NEED(b, st->iterations > 0, "iterations");
    PERI_NEED(b, st->newton > 0, "newton");
    PERI_NEED(b, st->breaks >= 0, "breaks");
    PERI_NEED(b, st->steps > 0, "steps");
    PERI_NEED(b, st->halvings >= 0 && st->halvings <= 60, "halvings");
    PERI_NEED(b, st->curve_rows >= 0 && (st->curve || st->curve_rows == 0), "curve");
    if (st->curve_load != 0 || st->curve_rows > 0) {
        const int64_t curve = peri__find(b, PERI_KIND_LOAD, st->curve_load, "curve_load");
        if (curve < 0) return (int32_t)curve;
    }
    PERI_NEED_NUMBER(b, st->duration >= 0.0, st->duration);
    if (b->model->centroid) return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    if (b->model->law_of && st->control == PERI_CONTROL_FRACTURE) return peri__fail(b, PERI_ERROR_LAW, "control", -1, st->control);
    if (b->model->inelastic && st->method == PERI_METHOD_BICGSTAB) return peri__fail(b, PERI_ERROR_LAW, "method", -1, st->method);
    if (b->model->inelastic && st->control != PERI_CONTROL_LOAD) return peri__fail(b, PERI_ERROR_LAW, "control", -1, st->control);
    if (b->contact && st->method == PERI_METHOD_BICGSTAB) return peri__fail(b, PERI_ERROR_LAW, "method", -1, st->method);
    return PERI_OK;
}

/* ---- load steps --------------------------------------------------------------------------------------------------- */

/* Equilibrium at a load factor, with all that breaks there. After a break it is sought roughly, as far as tells which bond is next, and to
   the tolerance once none is. */
static int32_t peri__static_step(peri__solver *s, double factor) {
    peri_body *b = s->body;
    int32_t status = peri__set_factor(s, factor);
    s->broken_before = s->report.broken;
    double broken = s->disturbed ? peri__static_energy(b) : 0.0; /* elastic energy after bonds broke, or on_step changed the body */
    for (int64_t round = 0, rounds = 0; status == PERI_OK; ++round) {
        if (s->from) memcpy(s->from, b->u, peri__vector_bytes(b));
        const double damping = b->now.ledger.damping;
        status = peri__equilibrium(s, round == 0 ? PERI__ANEW : s->rough > 0.0 ? PERI__AFTER_BREAK : PERI__AS_PREPARED);
        if (status != PERI_OK) break;
        double external = b->now.ledger.external, energy = 0.0, most = 0.0, flowed = b->now.ledger.damping - damping, lost;
        peri__count_work(s, s->from);
        const int64_t broke = peri__keep_static(s, &lost);
        status = peri__heed_laws(b);
        if (status < 0) break;
        if (peri__may_break(s) || s->disturbed) energy = peri__static_energy(b);
        if (round > 0 || s->disturbed) b->now.ledger.damping += b->now.ledger.external - external - (energy - broken) - lost - flowed;
        s->disturbed = 0;
        broken = energy;
        if (peri__may_break(s)) most = peri__most_excess(b);
        if (most <= 1.0 && s->rough == 0.0 && broke == 0) break;
        s->rough = most > 1.0 || broke > 0 ? PERI_ROUGH : 0.0;
        if (!(most > 1.0)) continue;
        (void)peri__break_static(s, most, 1.0);
        broken = peri__static_energy(b);
        b->now.ledger.fracture += energy - broken;
        if (rounds++ >= s->settings->breaks)
            status = peri__fail_step(s, PERI_ERROR_CONVERGENCE, "breaks", -1, (double)s->report.broken);
    }
    s->rough = 0.0;
    return status;
}

/* Reactions and on_step at the equilibrium. Bonds that on_step cuts are answered as those that break: by another equilibrium at the same
   factor, and on_step again, until it cuts none. */
static int32_t peri__show_settled(peri__solver *s) {
    int32_t status = peri__show_step(s, 0);
    for (int64_t rounds = 0; status == PERI_OK && s->cut; ++rounds) {
        if (rounds >= s->settings->breaks) return peri__fail_step(s, PERI_ERROR_CONVERGENCE, "breaks", -1, (double)s->report.broken);
        status = peri__static_step(s, s->body->now.load_factor);
        if (status == PERI_OK) status = peri__show_step(s, 1);
    }
    return status;
}

/* From one planned load factor to the next, in as many steps as it takes. */
static int32_t peri__load_step(peri__solver *s, double from, double to) {
    peri_body *b = s->body;
    double at = 0.0, part = 1.0, least = ldexp(1.0, -(int)s->settings->halvings);
    int32_t status = PERI_OK;
    while (at < 1.0 && status == PERI_OK) {
        int64_t broken = s->report.broken;
        double next = at + part < 1.0 ? at + part : 1.0;
        if (s->before) memcpy(s->before, b->u, peri__vector_bytes(b));
        s->t.step = (next - at) * s->settings->duration / (double)s->settings->steps / b->model->time;
        status = peri__static_step(s, next < 1.0 ? from + next * (to - from) : to);
        if (status == PERI_OK) {
            status = peri__show_settled(s);
            if (status == PERI_OK) status = peri__heed_callbacks(b);
            at = next;
            part *= 2.0;
            continue;
        }
        if (s->before && s->report.broken == broken) {
            int halved = status == PERI_ERROR_CONVERGENCE || status == PERI_ERROR_INDEFINITE;
            part *= 0.5;
            halved = halved && part >= least && !peri__is_linear(b);
            if (halved || (s->report.steps > 0 && status != PERI_STOPPED)) memcpy(b->u, s->before, peri__vector_bytes(b));
            if (halved) status = PERI_OK;
        }
    }
    return status;
}

static int32_t peri__load_steps(peri__solver *s) {
    peri_body *b = s->body;
    const peri_solve_desc *st = s->settings;
    int32_t status = peri__take_solver(s);
    if (status == PERI_OK) status = peri__settle_past(b);
    if (status == PERI_OK) status = peri__ensure(b, PERI__STALE_LEDGER);
    if (status < 0) return status;
    double from = s->load_from;
    b->now.still = 1;
    peri__changed(b, PERI__ACTION);
    b->now.load_factor = from;
    if (s->from) memcpy(s->from, b->u, peri__vector_bytes(b));
    if (s->load) status = peri__note_forces(s);
    if (st->control == PERI_CONTROL_FRACTURE) return status == PERI_OK ? peri__follow(s) : status;
    for (int64_t k = 1; k <= st->steps && status == PERI_OK; ++k) {
        double to = k < st->steps ? s->load_from + (st->load_to - s->load_from) * (double)k / (double)st->steps : st->load_to;
        status = peri__load_step(s, from, to);
        from = to;
    }
    return status;
}

/* Why the solve ended, to the report. A body that its own bonds have let come apart is no failure: it stands as it did before the last of
   them broke. */
static int32_t peri__tell_end(peri__solver *s, int32_t status) {
    if (status == PERI_ERROR_LOOSE && s->report.broken > s->broken_before) {
        s->report.ended = PERI_ENDED_SEVERED;
        s->report.load_factor = s->body->now.load_factor;
        return PERI_OK;
    }
    if (status == PERI_STOPPED) s->report.ended = PERI_ENDED_STOPPED;
    else if (status == PERI_OK && s->report.ended == 0) s->report.ended = PERI_ENDED_LOAD;
    return status;
}

/* A solve that ended short of an equilibrium has moved the body: like a change by the caller, to `initial`. */
static void peri__count_stray(peri__solver *s) {
    peri_body *b = s->body;
    b->now.ledger.initial += peri__static_energy(b) - peri__energy_under(b, s->from, NULL) - peri__contact_energy_under(b, s->from);
}

PERI_API int32_t peri_solve(peri_body *b, const peri_solve_desc *st, peri_solve_report *report) {
    PERI_NEED_IDLE(b);
    PERI_NEED_WHOLE(b, "peri_solve");
    peri__solver s;
    int32_t status = peri__check_statics(b, st);
    if (status == PERI_OK) status = peri__check_whole(b);
    if (report) memset(report, 0, sizeof *report);
    if (status < 0) return status;
    memset(&s, 0, sizeof s);
    s.body = b;
    s.settings = st;
    const double factor = b->now.load_factor;
    const int32_t still = b->now.still;
    s.load_from = !peri__is_nan(st->load_from) ? st->load_from : b->now.loaded ? factor : 0.0;
    if (!peri__finite(peri__stored(st->load_to - s.load_from))) return peri__fail(b, PERI_ERROR_RANGE, "load_to", -1, st->load_to);
    const int32_t former = peri__begin_run(b);
    status = peri__load_steps(&s);
    status = peri__tell_end(&s, status);
    peri__end_run(b, former);
    if (status < 0 && status == s.failure.code) b->error = s.failure;
    if (status < 0 && b->break_said < 0) status = peri__heed_callbacks(b);
    if (status >= 0) b->now.loaded = 1;
    if (status < 0) {
        b->now.load_factor = s.report.steps > 0 ? s.report.load_factor : s.begun ? s.load_from : factor;
        b->now.still = s.begun ? 1 : still;
        peri__changed(b, PERI__ACTION);
    }
    if (status != PERI_OK && s.from && s.begun) peri__count_stray(&s);
    b->now.stale |= PERI__STALE_STRETCH;
    peri__free_solver(&s);
    if (report) *report = s.report;
    return status;
}
