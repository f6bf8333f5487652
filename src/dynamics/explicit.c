/* SPDX-License-Identifier: MIT */
/* explicit.c - explicit dynamics: the stable step and the step loop.

   A step from n to n+1 ([T] 2.2, with damping a, h = a dt/2; velocity-Verlet | central difference):
     drive     supported dofs get the velocity that their support prescribes
     kick      v = (1-h) v + dt/2 f/rho        |  v = ((1-h) v + dt f/rho)/(1+h)
     drift     u += dt v
     force     f = loads + obstacles + bonds; bonds past their critical stretch break
     hold      reactions are noted
     kick      v = (v + dt/2 f/rho)/(1+h)      |  none: v stays at the half step until the run ends or a frame is shown
   Both are the same motion; the second makes one kick of two.

   A bond that breaks at n+1 is not in f. Under PERI_BREAK_WITHIN_STEP the closing kick still has what the bond gives until it meets its
   criterion, within the step, and fracture is the energy that it has then: motion and ledger are off by O(dt^2). */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_RUN (UINT64_C(0x7065726900030000) + sizeof(peri_advance_desc))

PERI_API void peri_advance_desc_init(peri_advance_desc *r) {
    if (!r) return;
    memset(r, 0, sizeof *r);
    r->cookie = PERI_COOKIE_RUN;
    r->integrator = PERI_INTEGRATOR_VELOCITY_VERLET;
    r->safety = 0.9;
    r->load_factor = (double)NAN;
}

/* The stable step, inner units: 2/sqrt(lambda), lambda <= largest row sum of the stiffness over the mass (Gershgorin): bonds count twice,
   once on the diagonal and once off it; `sharp`: or what is closer; obstacles once, taken as if all touched the lightest point; contact as
   it is, but not less than some touching. The springs of a free obstacle lie between two masses: K <= 2 (K of the points + K of the free
   one), so they count twice, or as much as they are for it alone. With coefficients of velocity c, over the density, what is lambda without
   them leaves the step (sqrt(c^2/4 + lambda) - c/2) 2/lambda. */
static double peri__step_of(const peri_body *b, double sharp) {
    const peri__model *m = b->model;
    const double lightest = peri__least_density(b), damping = 0.5 * peri__damping_limit(b);
    double lambda = fmax(b->largest_row_sum, m->row_sum * b->row_sum_factor), alone = 0.0;
    if (m->gathers & PERI__GRADIENT) lambda *= b->now.stiffer; /* of springs, the bound holds however they are stretched */
    if (sharp * b->now.stiffer < lambda) lambda = sharp * b->now.stiffer;
    for (int64_t k = 0; k < b->obstacle_count; ++k) {
        const peri__obstacle *o = &b->obstacles[k];
        if (!o->kind) continue;
        lambda += (o->free ? 2.0 : 1.0) * o->stiffness / lightest;
        if (o->free) alone = fmax(alone, 2.0 * peri__free_stiffness(o));
    }
    lambda = fmax(lambda, alone);
    const double step = peri__step_touched(b, lambda);
    if (damping > 0.0) lambda = 4.0 / (step * step);
    return damping > 0.0 && lambda < HUGE_VAL ? (sqrt(damping * damping + lambda) - damping) * 2.0 / lambda : step;
}

/* The crowd of contact, where the force does not tell. 0 where memory is short. */
static int peri__look_at_contact(peri_body *b) {
    if (!b->contact || !(b->now.stale & PERI__STALE_FORCE)) return 1;
    if (!peri__ready_contact(b)) return 0;
    (void)peri__press(b, 0);
    return 1;
}

/* By the bound, which costs nothing; and by the estimate too, where there is one that holds. */
static double peri__bounded(const peri_body *b) { return peri__step_of(b, HUGE_VAL); }

static double peri__stable(const peri_body *b) { return peri__step_of(b, b->now.stale & PERI__STALE_SHARP ? HUGE_VAL : b->sharp); }

/* The largest row sum of this part alone, where it is that of all. */
static void peri__own_row_sum(peri_body *b) {
    if (b->model->part && !b->model->pairwise) peri__find_largest_row_sum(b);
}

PERI_API double peri_stable_step(const peri_body *b) {
    if (!b || !b->model) return 0.0;
    (void)peri__ensure((peri_body *)b, PERI__STALE_CONSTANTS);
    if (b->running <= PERI__IN_FRAME) {
        if (b->now.stale & PERI__STALE_STRETCH) peri__look_at_stretch((peri_body *)b);
        (void)peri__look_at_contact((peri_body *)b);
        peri__look_at_free((peri_body *)b);
        (void)peri__sharpen((peri_body *)b);
        peri__own_row_sum((peri_body *)b);
        double most[2] = { b->largest_row_sum, b->now.stiffer };
        ((peri_body *)b)->told = 0;
        if (peri__agree((peri_body *)b, PERI_OK, 2, most) < 0) return 0.0;
        ((peri_body *)b)->largest_row_sum = most[0];
        ((peri_body *)b)->now.stiffer = most[1];
    }
    return peri__stable(b) * b->model->time;
}

static void peri__kick(peri_body *b, peri__operands *operands, int64_t *bad) {
    peri__supply_supports(b, operands);
    peri__still_ghosts(b);
    peri__for_points(b, b->model->points, 1, b->ops->kick, operands, b->sums);
    peri__sums total = peri__total(b->sums, b->model->points);
    b->now.ledger.damping += total.b;
    if (bad && *bad < 0) *bad = total.bad;
}

/* Central difference keeps v half a step behind. These move it there and back, with their half of what damping takes. */
static void peri__stagger(peri_body *b, double dt, double damping) {
    peri__operands operands = peri__operands_of(b);
    double h = 0.5 * damping * dt;
    operands.keep = 1.0 + h;
    operands.kick = -0.5 * dt;
    operands.loss_old = b->desc.ledger ? -h : 0.0;
    peri__kick(b, &operands, NULL);
}

static int32_t peri__unstagger(peri_body *b, double dt, double damping) {
    peri__operands operands = peri__operands_of(b);
    double h = 0.5 * damping * dt;
    int64_t bad = -1;
    operands.keep = 1.0 / (1.0 + h);
    operands.kick = 0.5 * dt * operands.keep;
    operands.loss_new = b->desc.ledger ? h : 0.0;
    peri__kick(b, &operands, &bad);
    return bad >= 0 ? peri__fail(b, PERI_ERROR_UNSTABLE, "peri_time", bad, b->now.time) : PERI_OK;
}

/* Adds the force of bonds to f and breaks those that meet their criterion: as within a step that took operands->step, whose drift was v,
   where operands->closing is given. Did some break? */
static int peri__forces_and_breaks(peri_body *b, peri__operands *operands) {
    const peri__model *m = b->model;
    if (b->before && b->alive) memcpy(b->before, b->alive, (size_t)(m->points * m->words) * sizeof *b->before);
    operands->breaking = b->alive != NULL && m->breakable;
    operands->working = m->seen_by & PERI__BY_WORK;
    operands->keeping = b->model->law_of ? 2 : 0;
    if (operands->breaking) peri__note_stresses(b, operands);
    operands->past.commit = m->inelastic != 0;
    if (m->inelastic && operands->breaking) peri__keep_force(b, operands);
    peri__bond_forces(b, operands);
    if (!operands->breaking) return 0;
    const peri__sums total = peri__total(b->sums, m->points);
    if (m->inelastic) {
        peri__break_inelastic(b, operands, total.n);
    } else if (!m->pairwise && total.n > 0) {
        peri__break_states(b, operands);
    } else {
        b->now.ledger.fracture += total.a;
        b->now.broken += total.n - (int64_t)total.b;
    }
    return total.n > 0;
}

/* At the end of a step, or before a run: what all parts are to know alike. They stop where one is asked to. */
static int32_t peri__agree_on_step(peri_body *b) {
    const uint32_t stale = b->now.stale & (PERI__STALE_FORCE | PERI__STALE_LEDGER);
    peri__own_row_sum(b);
    double most[4] = { b->largest_row_sum, b->now.stiffer, b->stop || b->break_said > 0, stale };
    if (!b->model->part) return PERI_OK;
    if (b->break_said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, "peri_break_fn", -1, b->break_said);
    const int32_t status = peri__agree(b, PERI_OK, 4, most);
    if (status < 0) return status;
    b->largest_row_sum = most[0];
    b->now.stiffer = most[1];
    b->stop = most[2] > 0.0;
    if (most[3] > 0.0) b->now.stale |= PERI__STALE_FORCE;
    return most[3] >= PERI__STALE_LEDGER ? peri__note_energy(b) : PERI_OK;
}

/* One step of dt (inner units) to the time `next`, as the context has it: here a peri_advance_desc. */
typedef int32_t (*peri__step_fn)(void *context, peri_body *b, double dt, double next, double damping);

typedef struct peri__half_way { /* a step under way                                                                          */
    peri__operands operands;
    int64_t bad;    /* first point whose motion is not finite, or -1                                                        */
    int     listed; /* 0: the lists of contact miss what has come near of late                                              */
    int     broke;
} peri__half_way;

/* Up to the forces of all but what other bodies do, and of supports. */
static int32_t peri__begin_step(const peri_advance_desc *r, peri_body *b, double dt, double next, double damping, peri__half_way *half) {
    int central = r->integrator == PERI_INTEGRATOR_CENTRAL_DIFFERENCE;
    double h = 0.5 * damping * dt;
    peri__operands *operands = &half->operands;
    half->bad = -1;
    half->listed = 1;
    *operands = peri__operands_of(b);
    int32_t status = peri__drive_supports(b, dt, damping);
    if (status < 0) {
        (void)peri__share_ghosts(b); /* for which other parts wait */
        peri__changed(b, PERI__ACTION);
        return status;
    }

    operands->keep = central ? (1.0 - h) / (1.0 + h) : 1.0 - h;
    operands->kick = central ? dt / (1.0 + h) : 0.5 * dt;
    operands->drift = dt;
    operands->loss_old = b->desc.ledger ? h : 0.0;
    operands->loss_new = central ? operands->loss_old : 0.0;
    peri__kick(b, operands, &half->bad);
    b->now.time = next;
    b->now.steps++;

    status = peri__share_ghosts(b);
    if (status == PERI_OK) status = peri__apply_loads(b, next, dt);
    if (status == PERI_OK) status = peri__apply_obstacles(b, next, dt);
    if (status < 0) {
        peri__changed(b, PERI__ACTION);
        return status;
    }
    operands->step = dt;
    half->broke = peri__forces_and_breaks(b, operands);
    status = peri__heed_laws(b);
    if (status < 0) {
        peri__changed(b, PERI__ACTION);
        return status;
    }
    if (half->broke && b->closing) peri__close_step(b);
    if (b->contact) {
        half->listed = half->broke ? peri__ready_after_breaks(b, dt) : peri__ready_contact(b);
        peri__apply_touch(b, dt, 1);
    }
    return PERI_OK;
}

static int32_t peri__finish_step(const peri_advance_desc *r, peri_body *b, double dt, double damping, peri__half_way *half) {
    double h = 0.5 * damping * dt;
    peri__operands *operands = &half->operands;
    peri__hold_supports(b, dt, damping);

    if (r->integrator != PERI_INTEGRATOR_CENTRAL_DIFFERENCE) {
        operands->keep = 1.0 / (1.0 + h);
        operands->kick = 0.5 * dt / (1.0 + h);
        operands->drift = 0.0;
        operands->loss_new = operands->loss_old;
        operands->loss_old = 0.0;
        peri__kick(b, operands, &half->bad);
    }
    peri__look_in_time(b);
    if (half->broke) peri__note_breaks(b, peri__load_time(b));
    if (b->before && half->broke) peri__report_breaks(b);
    if (half->bad >= 0) return peri__fail(b, PERI_ERROR_UNSTABLE, "peri_time", half->bad, b->now.time);
    if (half->listed) return peri__agree_on_step(b);
    peri__changed(b, PERI__ACTION); /* the step was done by lists that miss what has come near of late */
    return peri__fail(b, PERI_ERROR_MEMORY, "contact", -1, 0.0);
}

static int32_t peri__one_step(void *context, peri_body *b, double dt, double next, double damping) {
    const peri_advance_desc *r = (const peri_advance_desc *)context;
    peri__half_way half;
    const int32_t status = peri__begin_step(r, b, dt, next, damping, &half);
    return status < 0 ? status : peri__finish_step(r, b, dt, damping, &half);
}

/* Parts run alike, as long and by the same steps. */
static int32_t peri__agree_on_run(peri_body *b, const peri_advance_desc *r) {
    const double own[10] = { (double)r->steps, r->duration, r->time_step, r->safety, r->damping, (double)r->frame_steps, r->integrator,
                             r->force_step, b->now.time, r->on_frame != NULL };
    int32_t status = peri__agree_on_step(b);
    for (int k = 0; b->model->part && k < 10 && status == PERI_OK; k += 2) {
        double most[4] = { own[k], -own[k], own[k + 1], -own[k + 1] };
        status = peri__agree(b, status, 4, most);
        if (status == PERI_OK && (most[0] != -most[1] || most[2] != -most[3]))
            status = peri__fail(b, PERI_ERROR_PART, "peri_advance_desc", -1, 0.0);
    }
    return status;
}

static int32_t peri__check_length(peri_body *b, const peri_advance_desc *r) {
    PERI_NEED(b, r, "desc");
    if (r->cookie != PERI_COOKIE_RUN) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_FLAG(b, r->force_step);
    PERI_NEED_CHOICE(b, integrator, r->integrator);
    PERI_NEED_NUMBER(b, r->duration >= 0.0, r->duration);
    PERI_NEED_NUMBER(b, r->time_step >= 0.0, r->time_step);
    PERI_NEED_NUMBER(b, r->safety > 0.0 && r->safety <= 1.0, r->safety);
    PERI_NEED_NUMBER(b, r->damping >= 0.0, r->damping);
    if (!peri__is_nan(r->load_factor)) PERI_NEED_NUMBER(b, 1, r->load_factor);
    PERI_NEED(b, r->frame_steps >= 0, "frame_steps");
    PERI_NEED(b, r->steps >= 0, "steps");
    if ((r->steps > 0) == (r->duration > 0.0)) return peri__fail(b, PERI_ERROR_ARGUMENT, "duration", -1, r->duration);
    if (r->duration > 0.0 && !(peri__stored(r->duration / b->model->time) > 0.0)) /* in the unit of time it may vanish */
        return peri__fail(b, PERI_ERROR_RANGE, "duration", -1, r->duration);
    return PERI_OK;
}

/* With a stable step [T]. */
static int32_t peri__check_step(peri_body *b, const peri_advance_desc *r, double stable) {
    const double unit = b->model->time, step = r->time_step > 0.0 ? r->time_step : r->safety * stable;
    if (!(peri__stored(step / unit) > 0.0)) return peri__fail(b, PERI_ERROR_RANGE, r->time_step > 0.0 ? "time_step" : "safety", -1, step);
    if (peri__stored(r->damping * step) > 2.0) return peri__fail(b, PERI_ERROR_RANGE, "damping", -1, r->damping);
    if (r->time_step > stable * (1.0 + 1e-12) && !r->force_step)
        return peri__fail(b, PERI_ERROR_STEP, "time_step", -1, stable);
    if (r->time_step > stable) peri__log(b, 1, "time_step is larger than the stable step, as forced");
    return PERI_OK;
}

static int32_t peri__check_run(peri_body *b, const peri_advance_desc *r) {
    int32_t status = peri__check_length(b, r);
    if (status < 0) return status;
    (void)peri__ensure(b, PERI__STALE_CONSTANTS);
    if (b->now.stale & PERI__STALE_STRETCH) peri__look_at_stretch(b);
    peri__look_at_free(b);
    if (!peri__look_at_contact(b)) return peri__fail(b, PERI_ERROR_MEMORY, "contact", -1, 0.0);
    status = peri__agree_on_run(b, r);
    if (status < 0) return status;
    const double unit = b->model->time;
    if (!(r->time_step > 0.0 && r->time_step <= peri__bounded(b) * unit) && !peri__sharpen(b)) /* else the estimate has no say */
        return peri__fail(b, PERI_ERROR_MEMORY, "time_step", -1, r->time_step);
    return peri__check_step(b, r, peri__stable(b) * unit);
}

/* on_frame, and what it may have changed. */
static int32_t peri__show_frame(peri_body *b, const peri_advance_desc *r) {
    const int32_t former = peri__enter(b, PERI__IN_FRAME);
    const int32_t said = r->on_frame(r->user, b);
    peri__leave(b, former);
    int32_t status = peri__heed(b, said, "peri_frame_fn");
    if (b->model->part && status >= 0) {
        b->stop |= status == PERI_STOPPED;
        (void)peri__ensure(b, PERI__STALE_CONSTANTS);
        status = peri__agree_on_step(b);
        if (status == PERI_OK && b->stop) status = PERI_STOPPED;
    }
    if (status != PERI_OK) return status;
    status = peri__settle_past(b);
    if (status == PERI_OK) status = peri__ensure(b, PERI__STALE_FORCE | PERI__STALE_LEDGER);
    return status == PERI_OK ? peri__agree_on_step(b) : status;
}

/* The rest of a run from the time `start` on: `full` steps of dt, the others, at most two, of `last`; to `end` where a duration is given.
   Two, since one alone could be so short that rounding over it would be all of the velocities and reactions of supports. */
typedef struct peri__plan {
    double  dt, last, start, end;
    int64_t full, steps, done;
} peri__plan;

/* How many steps of plan->dt `left` [T] takes; of a run by steps that is known. */
static int32_t peri__count_steps(peri_body *b, const peri_advance_desc *r, double left, const peri__plan *plan, int64_t *steps) {
    *steps = 0;
    if (r->steps > 0) return PERI_OK;
    double duration = left / b->model->time, count = ceil(duration / plan->dt * (1.0 - 1e-12));
    if (count >= 9e18) return peri__fail(b, PERI_ERROR_RANGE, "duration", -1, r->duration);
    if (count < 1.0 && duration > 0.0) count = 1.0; /* however short */
    *steps = (int64_t)count;
    return PERI_OK;
}

static void peri__lay_steps(const peri_body *b, const peri_advance_desc *r, double left, int64_t steps, peri__plan *plan) {
    plan->start = b->now.time;
    plan->steps -= plan->done;
    plan->full = plan->steps;
    plan->done = 0;
    if (r->steps > 0) return;
    plan->steps = plan->full = steps;
    plan->last = left / b->model->time - (double)(plan->steps - 1) * plan->dt;
    if (!(plan->last < plan->dt)) return;
    plan->full = plan->steps > 2 ? plan->steps - 2 : 0;
    if (plan->steps > 1) plan->last = 0.5 * (plan->last + plan->dt);
}

static int32_t peri__plan_steps(peri_body *b, const peri_advance_desc *r, double left, peri__plan *plan) {
    int64_t steps;
    const int32_t status = peri__count_steps(b, r, left, plan, &steps);
    if (status == PERI_OK) peri__lay_steps(b, r, left, steps, plan);
    return status;
}

static double peri__next_size(const peri__plan *plan) { return plan->done < plan->full ? plan->dt : plan->last; }

/* Is a step of `size` too large by now? State-based bonds that broke, or what on_frame cut or added, can have made it so. */
static int peri__outrun(const peri_body *b, const peri_advance_desc *r, double size) {
    return !(r->force_step && r->time_step > 0.0) && size > peri__stable(b) * (1.0 + 1e-12);
}

/* Goes on with steps that are stable as the body is now, or tells what they would be. */
static int32_t peri__fit_steps(peri_body *b, const peri_advance_desc *r, peri__plan *plan) {
    if (!peri__outrun(b, r, peri__next_size(plan))) return PERI_OK;
    if (!peri__sharpen(b)) return peri__fail(b, PERI_ERROR_MEMORY, "time_step", -1, r->time_step);
    if (!peri__outrun(b, r, peri__next_size(plan))) return PERI_OK;
    if (r->time_step > 0.0) return peri__fail(b, PERI_ERROR_STEP, "time_step", -1, peri__stable(b) * b->model->time);
    plan->dt = r->safety * peri__stable(b);
    return peri__plan_steps(b, r, plan->end - b->now.time, plan);
}

static int32_t peri__march(peri_body *b, const peri_advance_desc *r, peri__step_fn step, void *context) {
    const peri__model *m = b->model;
    int central = r->integrator == PERI_INTEGRATOR_CENTRAL_DIFFERENCE;
    double damping = r->damping * m->time;
    int64_t left_to_frame = r->frame_steps;
    peri__plan plan = { 0.0, 0.0, 0.0, b->now.time + r->duration, 0, r->steps, 0 };
    plan.dt = r->time_step > 0.0 ? r->time_step / m->time : r->safety * peri__stable(b);
    int32_t status = peri__plan_steps(b, r, r->duration, &plan);
    if (status == PERI_OK) status = peri__settle_past(b);
    if (status == PERI_OK) status = peri__ensure(b, PERI__STALE_FORCE | PERI__STALE_LEDGER);
    if (status == PERI_OK) status = peri__agree_on_step(b);
    if (status == PERI_OK) status = peri__heed_callbacks(b);
    if (status == PERI_OK) status = peri__fit_steps(b, r, &plan); /* what free obstacles are near is known by now */
    while (plan.done < plan.steps && status == PERI_OK) {
        /* a stretch of steps of one size, up to the next frame */
        int64_t stretch = (plan.done < plan.full ? plan.full : plan.steps) - plan.done, run = 0;
        double size = peri__next_size(&plan);
        if (r->on_frame && r->frame_steps > 0 && stretch > left_to_frame) stretch = left_to_frame;
        if (central) peri__stagger(b, size, damping);
        while (run < stretch && status == PERI_OK && (run == 0 || !(peri__outrun(b, r, size) || peri__heed_callbacks(b)))) {
            int64_t full = plan.done < plan.full ? plan.done + 1 : plan.full;
            double next = plan.start + ((double)full * plan.dt + (double)(plan.done + 1 - full) * plan.last) * m->time;
            if (plan.done + 1 == plan.steps && r->steps == 0) next = plan.end;
            status = step(context, b, size, next, damping);
            run++;
            plan.done++;
        }
        if (central && (status == PERI_OK || status == PERI_ERROR_MEMORY)) {
            const int32_t back = peri__unstagger(b, size, damping);
            if (status == PERI_OK || back < 0) status = back;
            if (status == PERI_OK) status = peri__agree(b, status, 0, NULL);
        }
        left_to_frame -= run;
        if (status != PERI_OK) break;
        const int32_t heeded = peri__heed_callbacks(b);
        if (heeded < 0) return heeded;
        if (r->on_frame && (plan.done == plan.steps || heeded == PERI_STOPPED || (r->frame_steps > 0 && left_to_frame == 0))) {
            left_to_frame = r->frame_steps;
            status = peri__show_frame(b, r);
        }
        if (status == PERI_OK) status = peri__heed_callbacks(b);
        if (status == PERI_OK && plan.done < plan.steps) status = peri__fit_steps(b, r, &plan);
    }
    return status;
}

static void peri__begin_loading(peri_body *b, const peri_advance_desc *r) {
    const double factor = !peri__is_nan(r->load_factor) ? r->load_factor : b->now.loaded ? b->now.load_factor : 1.0;
    if (b->now.still || factor != b->now.load_factor) peri__changed(b, PERI__ACTION); /* callbacks are asked for another time */
    b->now.still = 0;
    b->now.loaded = 1;
    b->now.load_factor = factor;
}

/* The run itself, by the steps of any method; begun and ended by the caller. */
static int32_t peri__run(peri_body *b, const peri_advance_desc *r, peri__step_fn step, void *context) {
    peri__begin_loading(b, r);
    return peri__march(b, r, step, context);
}

PERI_API int32_t peri_advance(peri_body *b, const peri_advance_desc *r) {
    PERI_NEED_IDLE(b);
    b->told = b->break_said = b->stop = 0;
    int32_t status = peri__check_run(b, r);
    if (status == PERI_OK) status = peri__check_whole(b);
    if (status < 0) return peri__tell_parts(b, status);
    const int32_t former = peri__begin_run(b);
    peri_advance_desc settings = *r;
    status = peri__run(b, &settings, peri__one_step, &settings);
    peri__end_run(b, former);
    return peri__tell_parts(b, status);
}

