/* SPDX-License-Identifier: MIT */
/* callbacks.c - how a run begins and ends, what callbacks have said meanwhile, and what becomes of a body that one was left in by a jump.

   A jump (longjmp, an exception) skips all that the interrupted call would still have done. What that was is known without it: blocks of
   b->scratch are those that calls under way have taken, b->building is the model that peri_build had not handed over, and a torn body is
   one whose run has not ended. All else a call changes where no callback comes between. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Refuses a body that a jump left within a run. */
static int32_t peri__check_whole(peri_body *b) {
    return b->now.torn ? peri__fail(b, PERI_ERROR_ORDER, "peri_reset", -1, 0.0) : PERI_OK;
}

/* Returns who was at work, for peri__end_run. */
static int32_t peri__begin_run(peri_body *b) {
    if (b->seat && !b->seat->world->running) peri__rouse(b->seat);
    if (b->now.pushed && !(b->seat && b->seat->world->running)) peri__changed(b, PERI__ACTION); /* alone, others do not push it */
    b->stop = 0;
    b->break_said = 0;
    b->law_bad = -1;
    b->past.settling = 0;
    b->now.torn = 1;
    return peri__enter(b, PERI__IN_CALLBACK);
}

static void peri__end_run(peri_body *b, int32_t former) {
    b->now.torn = 0;
    peri__leave(b, former);
}

/* To be asked at a whole step: PERI_STOPPED where a load, an obstacle or on_break wished to stop; or that on_break or a law failed. */
static int32_t peri__heed_callbacks(peri_body *b) {
    const int32_t status = peri__heed_laws(b);
    if (status < 0) return status;
    if (b->break_said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, "peri_break_fn", -1, b->break_said);
    return b->stop || b->break_said > 0 ? PERI_STOPPED : PERI_OK;
}

/* What on_frame, on_step or on_iteration returned, as a status. */
static int32_t peri__heed(peri_body *b, int32_t said, const char *field) {
    if (said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, field, -1, said);
    return said > 0 ? PERI_STOPPED : PERI_OK;
}

PERI_API int32_t peri_unlock(peri_body *b) {
    PERI_NEED_BODY(b);
    if (!b->running) return peri__fail(b, PERI_ERROR_ORDER, "peri_unlock", -1, 0.0);
    b->running = PERI__IDLE;
    if (b->seat) b->seat->world->running = 0;
    b->influence_said = 0;
    peri__drop_build(b);
    peri__delete_all_taken(&b->scratch);
    if (b->now.torn) peri__changed(b, PERI__BONDS); /* the step that was under way kept nothing of this up to date */
    return PERI_OK;
}
