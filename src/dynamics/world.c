/* SPDX-License-Identifier: MIT */
/* world.c - bodies of a world that advance together: the steps of explicit.c, of one size in time, with the forces between bodies before
   the second kick. A body of a world of one, and one that nobody touches, goes through the same arithmetic as alone. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* The least stable step [T], and whose it is. */
static double peri__stable_of_world(const peri_world *w, int64_t *leader) {
    double least = HUGE_VAL;
    *leader = 0;
    for (int64_t k = 0; k < w->seats; ++k) {
        const double step = peri__stable(peri__nth_body(w, k)) * peri__nth_body(w, k)->model->time;
        if (step < least) {
            least = step;
            *leader = k;
        }
    }
    return least;
}

/* Brings up to date what stable steps follow from. */
static int32_t peri__look_at_world(peri_world *w) {
    int fits = 1;
    for (int64_t k = 0; k < w->seats; ++k) {
        peri_body *b = peri__nth_body(w, k);
        (void)peri__ensure(b, PERI__STALE_CONSTANTS);
        if (b->now.stale & PERI__STALE_STRETCH) peri__look_at_stretch(b);
        peri__look_at_free(b);
        if (!peri__look_at_contact(b)) return peri__world_heed(w, b, peri__fail(b, PERI_ERROR_MEMORY, "contact", -1, 0.0));
        if (!b->density) continue;
        peri__weigh_seat(w->seat[k]); /* it may be another */
        peri__weigh_members(w->seat[k]);
        fits = 0;
    }
    const int32_t status = fits ? PERI_OK : peri__fit_or_tell(w);
    if (status < 0) return status;
    if (!peri__ready_world(w)) return peri__world_fail(w, PERI_ERROR_MEMORY, "contact", -1, 0.0);
    (void)peri__press_world(w);
    return PERI_OK;
}

PERI_API double peri_world_stable_step(peri_world *w) {
    int64_t leader;
    double step = 0.0;
    if (!w || w->seats == 0) return 0.0;
    const int32_t former = w->running;
    for (int64_t k = 0; k < w->seats; ++k)
        if (peri__nth_body(w, k)->running > PERI__IN_FRAME) return 0.0;
    w->running = 1;
    if (peri__look_at_world(w) == PERI_OK) {
        for (int64_t k = 0; k < w->seats; ++k) (void)peri__sharpen(peri__nth_body(w, k));
        step = peri__stable_of_world(w, &leader);
    }
    w->running = former;
    return step;
}

/* ---- how long, and by which steps ------------------------------------------------------------------------------------------ */

static int32_t peri__check_tour(peri_world *w, const peri_advance_desc *r) {
    int64_t leader;
    int32_t status = PERI_OK;
    for (int64_t k = 0; k < w->seats && status == PERI_OK; ++k)
        status = peri__world_heed(w, peri__nth_body(w, k), peri__check_length(peri__nth_body(w, k), r));
    if (status == PERI_OK) status = peri__look_at_world(w);
    for (int64_t k = 0; k < w->seats && status == PERI_OK; ++k) {
        peri_body *b = peri__nth_body(w, k);
        if (!(r->time_step > 0.0 && r->time_step <= peri__bounded(b) * b->model->time) && !peri__sharpen(b))
            status = peri__world_heed(w, b, peri__fail(b, PERI_ERROR_MEMORY, "time_step", -1, r->time_step));
    }
    if (status < 0) return status;
    const double stable = peri__stable_of_world(w, &leader);
    for (int64_t k = 0; k < w->seats && status == PERI_OK; ++k)
        status = peri__world_heed(w, peri__nth_body(w, k), peri__check_step(peri__nth_body(w, k), r, stable));
    return status;
}

/* Plans the steps of all bodies: as many as the leader takes, each of the size of its own. */
static int32_t peri__plan_tour(peri__tour *t, int32_t first) {
    const peri_advance_desc *r = &t->settings;
    const peri_world *w = t->world;
    const peri_body *leader;
    int64_t count = 0;
    (void)peri__stable_of_world(w, &t->leader);
    leader = peri__nth_body(w, t->leader);
    const double least = r->safety * peri__stable(leader);
    for (int64_t turn = 0; turn <= w->seats; ++turn) { /* the leader first */
        const int64_t k = turn == 0 ? t->leader : turn - 1;
        peri_body *b = peri__nth_body(w, k);
        peri__plan *plan = &t->pace[k].plan;
        if (turn > 0 && k == t->leader) continue;
        if (r->time_step > 0.0) plan->dt = r->time_step / b->model->time;
        else plan->dt = k == t->leader ? least : least * (leader->model->time / b->model->time);
        const double left = first ? r->duration : plan->end - b->now.time;
        if (turn == 0) {
            const int32_t status = peri__count_steps(b, r, left, plan, &count);
            if (status < 0) return peri__world_heed(t->world, b, status);
        }
        peri__lay_steps(b, r, left, count, plan);
    }
    return PERI_OK;
}

static int peri__is_outrun(const peri__tour *t) {
    for (int64_t k = 0; k < t->world->seats; ++k)
        if (peri__outrun(peri__nth_body(t->world, k), &t->settings, peri__next_size(&t->pace[k].plan))) return 1;
    return 0;
}

/* Goes on with steps that are stable as the bodies are now, or tells what they would be. */
static int32_t peri__fit_tour(peri__tour *t) {
    const peri_advance_desc *r = &t->settings;
    int64_t leader;
    if (!peri__is_outrun(t)) return PERI_OK;
    for (int64_t k = 0; k < t->world->seats; ++k) {
        peri_body *b = peri__nth_body(t->world, k);
        if (!peri__sharpen(b)) return peri__world_heed(t->world, b, peri__fail(b, PERI_ERROR_MEMORY, "time_step", -1, r->time_step));
    }
    if (!peri__is_outrun(t)) return PERI_OK;
    if (!(r->time_step > 0.0)) return peri__plan_tour(t, 0);
    return peri__world_fail(t->world, PERI_ERROR_STEP, "time_step", -1, peri__stable_of_world(t->world, &leader));
}

/* ---- steps ----------------------------------------------------------------------------------------------------------------- */

/* PERI_STOPPED where somebody wished to stop. */
static int32_t peri__heed_world(peri_world *w) {
    int32_t status = PERI_OK;
    for (int64_t k = 0; k < w->seats; ++k) {
        const int32_t said = peri__heed_callbacks(peri__nth_body(w, k));
        if (said < 0) return peri__world_heed(w, peri__nth_body(w, k), said);
        if (said > 0) status = said;
    }
    return status;
}

/* One step of all. Of a body that fails in its first half all stop within the step; else all end it. */
static int32_t peri__step_together(peri__tour *t) {
    peri_world *w = t->world;
    const peri_advance_desc *r = &t->settings;
    int32_t status = PERI_OK;
    int64_t begun = 0;
    for (; begun < w->seats && status >= 0; ++begun)
        if (!w->seat[begun]->island) status = peri__begin_step_of(t, begun);
    for (int64_t k = 0; k < begun && status < 0; ++k) peri__changed(peri__nth_body(w, k), PERI__ACTION);
    if (status < 0) return status;
    int listed = peri__ready_world(w);
    while (status >= 0 && listed && peri__wake_touched(t, &status)) listed = peri__ready_world(w);
    if (status < 0) return status;
    (void)peri__press_world(w);
    for (int64_t k = 0; k < w->seats; ++k)
        if (!w->seat[k]->island) peri__push_body(w->seat[k], peri__next_size(&t->pace[k].plan) * w->seat[k]->time);
    for (int64_t k = 0; k < w->seats; ++k) {
        peri_body *b = peri__nth_body(w, k);
        peri__pace *pace = &t->pace[k];
        const double dt = peri__next_size(&pace->plan);
        if (w->seat[k]->island) {
            peri__sleep_on(b, peri__next_time(b, r, &pace->plan));
            pace->plan.done++;
            continue;
        }
        const int32_t ended = peri__finish_step(r, b, dt, r->damping * b->model->time, &pace->half);
        if (ended < 0 && status >= 0) status = peri__world_heed(w, b, ended);
        if (w->sleep_speed > 0.0) peri__note_calm(t, k);
        pace->plan.done++;
    }
    if (listed || status < 0) return status;
    for (int64_t k = 0; k < w->seats; ++k) peri__changed(peri__nth_body(w, k), PERI__ACTION);
    return peri__world_fail(w, PERI_ERROR_MEMORY, "contact", -1, 0.0);
}

/* Of central differences, before and after a stretch of steps of one size. */
static int32_t peri__stagger_world(const peri__tour *t, int back) {
    int32_t status = PERI_OK;
    for (int64_t k = 0; k < t->world->seats; ++k) {
        peri_body *b = peri__nth_body(t->world, k);
        peri__pace *pace = &t->pace[k];
        const double damping = t->settings.damping * b->model->time;
        if (!back) pace->size = peri__next_size(&pace->plan);
        if (t->world->seat[k]->island) continue;
        const int32_t said = back ? peri__unstagger(b, pace->size, damping) : PERI_OK;
        if (!back) peri__stagger(b, pace->size, damping);
        if (said < 0 && status >= 0) status = peri__world_heed(t->world, b, said);
    }
    return status;
}

static int32_t peri__bring_up_to_date(peri_world *w) {
    int32_t status = PERI_OK;
    for (int64_t k = 0; k < w->seats && status == PERI_OK; ++k) {
        peri_body *b = peri__nth_body(w, k);
        status = peri__settle_past(b);
        if (status == PERI_OK) status = peri__ensure(b, PERI__STALE_FORCE | PERI__STALE_LEDGER);
        status = peri__world_heed(w, b, status);
    }
    return status;
}

/* on_frame of one body after the other, each of which may change any. */
static int32_t peri__show_world(peri__tour *t) {
    peri_world *w = t->world;
    int32_t status = PERI_OK;
    for (int64_t k = 0; k < w->seats; ++k) (void)peri__enter(peri__nth_body(w, k), PERI__IN_FRAME);
    for (int64_t k = 0; k < w->seats && status >= 0; ++k) {
        peri_body *b = peri__nth_body(w, k);
        const int32_t said = peri__heed(b, t->settings.on_frame(t->settings.user, b), "peri_frame_fn");
        if (said != PERI_OK) status = peri__world_heed(w, b, said);
    }
    for (int64_t k = 0; k < w->seats; ++k) peri__leave(peri__nth_body(w, k), PERI__IN_CALLBACK);
    return status == PERI_OK ? peri__bring_up_to_date(w) : status;
}

/* Forces and ledgers as they are to be at the first step. */
static int32_t peri__settle_world(peri__tour *t) {
    peri_world *w = t->world;
    int32_t status = PERI_OK;
    int begins = 1;
    for (int64_t k = 0; k < w->seats && status == PERI_OK; ++k)
        status = peri__world_heed(w, peri__nth_body(w, k), peri__settle_past(peri__nth_body(w, k)));
    if (status < 0) return status;
    if (!peri__ready_world(w)) return peri__world_fail(w, PERI_ERROR_MEMORY, "contact", -1, 0.0);
    const double energy = peri__press_world(w);
    for (int64_t k = 0; k < w->seats; ++k) {
        if (!peri__is_pushed_as_now(w->seat[k])) peri__changed(peri__nth_body(w, k), PERI__ACTION);
        begins = begins && peri__nth_body(w, k)->now.steps == 0;
    }
    w->put_in = begins ? energy : w->put_in + energy - w->stored;
    status = peri__bring_up_to_date(w);
    if (status == PERI_OK) status = peri__heed_world(w);
    return status == PERI_OK ? peri__fit_tour(t) : status;
}

/* Steps of one size, up to the next frame. Returns how many to *run. */
static int32_t peri__stretch_of_steps(peri__tour *t, int64_t left_to_frame, int64_t *run) {
    const peri_advance_desc *r = &t->settings;
    const peri__plan *plan = &t->pace[0].plan;
    const int central = r->integrator == PERI_INTEGRATOR_CENTRAL_DIFFERENCE;
    int64_t stretch = (plan->done < plan->full ? plan->full : plan->steps) - plan->done;
    int32_t status = PERI_OK;
    if (r->on_frame && r->frame_steps > 0 && stretch > left_to_frame) stretch = left_to_frame;
    *run = 0;
    if (central) (void)peri__stagger_world(t, 0);
    while (*run < stretch && status == PERI_OK && (*run == 0 || !(peri__is_outrun(t) || peri__heed_world(t->world)))) {
        if (*run > 0 && peri__has_resting(t->world)) break;
        status = peri__step_together(t);
        ++*run;
    }
    if (!central || (status != PERI_OK && status != PERI_ERROR_MEMORY)) return status;
    const int32_t back = peri__stagger_world(t, 1);
    return status == PERI_OK || back < 0 ? back : status;
}

static int32_t peri__march_world(peri__tour *t) {
    const peri_advance_desc *r = &t->settings;
    const peri__plan *plan = &t->pace[0].plan;
    int64_t left_to_frame = r->frame_steps;
    int32_t status = peri__settle_world(t);
    while (plan->done < plan->steps && status == PERI_OK) {
        int64_t run;
        status = peri__stretch_of_steps(t, left_to_frame, &run);
        left_to_frame -= run;
        if (status != PERI_OK) break;
        if (peri__has_resting(t->world)) peri__lay_down(t->world);
        const int32_t heeded = peri__heed_world(t->world);
        if (heeded < 0) return heeded;
        if (r->on_frame && (plan->done == plan->steps || heeded == PERI_STOPPED || (r->frame_steps > 0 && left_to_frame == 0))) {
            left_to_frame = r->frame_steps;
            status = peri__show_world(t);
        }
        if (status == PERI_OK) status = peri__heed_world(t->world);
        if (status == PERI_OK && plan->done < plan->steps) status = peri__fit_tour(t);
    }
    return status;
}

/* ---- the run ---------------------------------------------------------------------------------------------------------------- */

/* Room for the run, which a callback that leaves it by a jump leaves to the world. */
static int peri__need_paces(peri_world *w) {
    const int64_t bytes = w->seats * (int64_t)sizeof(peri__pace);
    if (bytes <= w->pace_bytes) return 1;
    void *paces = peri__new(&w->memory, bytes, 1);
    if (!paces) return 0;
    peri__delete(&w->memory, w->paces, w->pace_bytes, 1);
    w->paces = paces;
    w->pace_bytes = bytes;
    return 1;
}

static int32_t peri__run_world(peri__tour *t) {
    peri_world *w = t->world;
    for (int64_t k = 0; k < w->seats; ++k) {
        peri_body *b = peri__nth_body(w, k);
        const int32_t former = peri__begin_run(b); /* idle */
        (void)former;
        peri__begin_loading(b, &t->settings);
        memset(&t->pace[k], 0, sizeof t->pace[k]);
        t->pace[k].plan.start = b->now.time;
        t->pace[k].plan.end = b->now.time + t->settings.duration;
        t->pace[k].plan.steps = t->settings.steps;
    }
    int32_t status = peri__plan_tour(t, 1);
    if (status == PERI_OK) status = peri__march_world(t);
    const peri_error error = w->error;
    if (peri__ready_world(w)) w->stored = peri__press_world(w);
    w->error = error;
    for (int64_t k = 0; k < w->seats; ++k) peri__end_run(peri__nth_body(w, k), PERI__IDLE);
    return status;
}

PERI_API int32_t peri_world_advance(peri_world *w, const peri_advance_desc *desc) {
    peri__tour tour;
    PERI_NEED_STILL(w);
    if (!desc) return peri__world_fail(w, PERI_ERROR_ARGUMENT, "desc", -1, 0.0);
    if (w->seats == 0) return peri__world_fail(w, PERI_ERROR_EMPTY, "peri_world_add", -1, 0.0);
    for (int64_t k = 0; k < w->seats; ++k) {
        peri_body *b = peri__nth_body(w, k);
        if (b->running) return peri__world_heed(w, b, peri__fail(b, PERI_ERROR_ORDER, "peri_unlock", -1, 0.0));
        const int32_t status = peri__world_heed(w, b, peri__check_whole(b));
        if (status < 0) return status;
    }
    if (!peri__need_paces(w)) return peri__world_fail(w, PERI_ERROR_MEMORY, "world", -1, 0.0);
    for (int64_t k = 0; k < w->seats; ++k) peri__nth_body(w, k)->break_said = peri__nth_body(w, k)->stop = 0;
    tour.world = w;
    tour.settings = *desc;
    tour.pace = (peri__pace *)w->paces;
    tour.leader = 0;
    w->running = 1;
    int32_t status = peri__check_tour(w, desc);
    if (status == PERI_OK) status = peri__run_world(&tour);
    w->running = 0;
    return status;
}
