/* SPDX-License-Identifier: MIT */
/* world_desc.c - worlds created and destroyed; bodies that come and go, and the contact between them as the caller declares it. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_WORLD (UINT64_C(0x7065726900300000) + sizeof(peri_world_desc))

PERI_API void peri_world_desc_init(peri_world_desc *d) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_WORLD;
}

/* Records a failure that is of no body. */
static int32_t peri__world_fail(peri_world *w, int32_t code, const char *field, int64_t index, double value) {
    w->failed = NULL;
    return peri__set_error(&w->error, code, field, index, value);
}

/* Records what has failed on a body, and returns the status. */
static int32_t peri__world_heed(peri_world *w, peri_body *b, int32_t status) {
    if (status >= 0) return status;
    w->failed = b;
    w->error = b->error;
    return status;
}

#define PERI_NEED_STILL(w)                                                                                             \
    if (!(w)) return PERI_ERROR_ARGUMENT;                                                                              \
    if ((w)->running) return peri__world_fail((w), PERI_ERROR_ORDER, "peri_unlock", -1, 0.0)

PERI_API int32_t peri_world_create(const peri_world_desc *desc, peri_world **world, peri_error *error) {
    (void)peri__set_error(error, PERI_OK, "", -1, 0.0);
    if (world) *world = NULL;
    if (!desc || !world) return peri__set_error(error, PERI_ERROR_ARGUMENT, desc ? "world" : "desc", -1, 0.0);
    if (desc->cookie != PERI_COOKIE_WORLD) return peri__set_error(error, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    if (!desc->allocate != !desc->release)
        return peri__set_error(error, PERI_ERROR_ARGUMENT, desc->allocate ? "release" : "allocate", -1, 0.0);
    if (!(peri__finite(desc->sleep_speed) && desc->sleep_speed >= 0.0))
        return peri__set_error(error, PERI_ERROR_RANGE, "sleep_speed", -1, desc->sleep_speed);
    if (!(peri__finite(desc->sleep_time) && desc->sleep_time >= 0.0) || (desc->sleep_speed > 0.0 && !(desc->sleep_time > 0.0)))
        return peri__set_error(error, PERI_ERROR_RANGE, "sleep_time", -1, desc->sleep_time);
    const peri__memory memory = peri__hooks(desc->allocate, desc->release, desc->memory_user);
    peri_world *w = (peri_world *)peri__new(&memory, 1, sizeof *w);
    if (!w) return peri__set_error(error, PERI_ERROR_MEMORY, "world", -1, 0.0);
    w->memory = memory;
    w->common_on = 1;
    w->sleep_speed = desc->sleep_speed;
    w->sleep_time = desc->sleep_time;
    peri_contact_desc_init(&w->common);
    (void)peri__world_fail(w, PERI_OK, "", -1, 0.0);
    *world = w;
    return PERI_OK;
}

PERI_API void peri_world_destroy(peri_world *w) {
    peri__memory memory;
    if (!w || w->running) return;
    memory = w->memory;
    while (w->seats > 0) peri__leave_world(w->seat[w->seats - 1]->body);
    peri__delete(&memory, w->paces, w->pace_bytes, 1);
    peri__delete(&memory, w->pair, w->born_capacity, sizeof *w->pair);
    peri__delete(&memory, w->touch, w->touch_capacity, sizeof *w->touch);
    peri__delete(&memory, w->seat, w->seat_capacity, sizeof(peri__seat *));
    peri__delete(&memory, w, 1, sizeof *w);
}

PERI_API int32_t peri_world_get_error(const peri_world *w, peri_error *error, peri_body **body) {
    if (body) *body = NULL;
    if (!w || !error) return PERI_ERROR_ARGUMENT;
    *error = w->error;
    if (body) *body = w->failed;
    return PERI_OK;
}

PERI_API int64_t peri_world_bytes(const peri_world *w) {
    if (!w) return PERI_ERROR_ARGUMENT;
    uint64_t bytes = peri__block_bytes(1, sizeof *w);
    if (w->paces) bytes += peri__block_bytes(w->pace_bytes, 1);
    if (w->pair) bytes += peri__block_bytes(w->born_capacity, sizeof *w->pair);
    if (w->touch) bytes += peri__block_bytes(w->touch_capacity, sizeof *w->touch);
    if (w->seat) bytes += peri__block_bytes(w->seat_capacity, sizeof(peri__seat *));
    for (int64_t k = 0; k < w->seats; ++k) {
        const peri__seat *s = w->seat[k];
        bytes += peri__block_bytes(1, sizeof *s) + peri__block_bytes(s->body->model->points, 1);
        if (!s->watch) continue;
        bytes += peri__block_bytes(s->watch_capacity * w->dim, sizeof *s->at) + peri__block_bytes(s->watch_capacity, sizeof *s->watch);
    }
    return (int64_t)bytes + peri__roll_bytes(w);
}

/* ---- contact between bodies ----------------------------------------------------------------------------------------------- */

/* Declares the contact of seats a and c; d NULL: there is none. */
static int32_t peri__declare_between(peri_world *w, int64_t a, int64_t c, const peri_contact_desc *d) {
    const double spacings = w->seat[a]->spacing + w->seat[c]->spacing;
    peri__touch *t = &w->touch[peri__seats_of(a, c)];
    memset(t, 0, sizeof *t);
    if (!d) return PERI_OK;
    t->on = 1;
    t->desc = *d;
    t->distance = d->distance > 0.0 ? d->distance / w->length : 0.5 * spacings;
    t->friction = d->friction;
    t->friction_speed = d->friction_speed / (w->length / w->time);
    if (t->distance <= spacings * (1.0 + 1e-12)) return PERI_OK;
    return peri__world_fail(w, PERI_ERROR_RANGE, "distance", -1, d->distance);
}

static int32_t peri__fit_or_tell(peri_world *w) {
    int64_t a, c;
    double value = 0.0;
    return peri__fit_world(w, &a, &c, &value) ? PERI_OK : peri__world_fail(w, PERI_ERROR_RANGE, "restitution", -1, value);
}

/* Seat of a body of this world; -1: of none, which is recorded. */
static int64_t peri__seat_of(peri_world *w, const peri_body *b, const char *field) {
    int64_t k = w->seats - 1;
    while (k >= 0 && w->seat[k]->body != b) --k;
    if (k < 0) (void)peri__world_fail(w, PERI_ERROR_ARGUMENT, field, -1, 0.0);
    return k;
}

PERI_API int32_t peri_world_set_contact(peri_world *w, const peri_body *a, const peri_body *b, const peri_contact_desc *d) {
    PERI_NEED_STILL(w);
    const int64_t p = a ? peri__seat_of(w, a, "a") : -1, q = b && (!a || p >= 0) ? peri__seat_of(w, b, "b") : -1;
    if ((a && p < 0) || (b && q < 0)) return w->error.code;
    if (a && a == b) return peri__world_fail(w, PERI_ERROR_ARGUMENT, "b", -1, 0.0);
    int32_t status = d ? peri__check_contact(d, HUGE_VAL, &w->error) : PERI_OK;
    if (status < 0) {
        w->failed = NULL;
        return status;
    }
    const int64_t pairs = w->seats * (w->seats - 1) / 2;
    peri__touch *former = (peri__touch *)peri__copy(&w->memory, w->touch, pairs, sizeof *former);
    if (!former) return peri__world_fail(w, PERI_ERROR_MEMORY, "contact", -1, 0.0);
    for (int64_t k = 1; k < w->seats && status == PERI_OK; ++k)
        for (int64_t l = 0; l < k && status == PERI_OK; ++l) {
            const int those = (p < 0 || p == k) && (q < 0 || q == l), others = (p < 0 || p == l) && (q < 0 || q == k);
            if (those || others) status = peri__declare_between(w, k, l, d);
        }
    if (status == PERI_OK) status = peri__fit_or_tell(w);
    if (status < 0) {
        const peri_error error = w->error;
        if (pairs > 0) memcpy(w->touch, former, (size_t)pairs * sizeof *former);
        (void)peri__fit_or_tell(w);
        w->error = error;
    } else if (!a && !b) {
        w->common_on = d != NULL;
        if (d) w->common = *d;
    }
    peri__delete(&w->memory, former, pairs, sizeof *former);
    w->listed = 0;
    peri__rouse_all(w);
    return status;
}

/* ---- bodies that come and go ---------------------------------------------------------------------------------------------- */

static peri__seat *peri__new_seat(peri_world *w, peri_body *b) {
    peri__seat *s = (peri__seat *)peri__new(&w->memory, 1, sizeof *s);
    if (!s) return NULL;
    s->body = b;
    s->world = w;
    s->base = w->numbers;
    s->dead = -1;
    s->mark = (uint8_t *)peri__new(&w->memory, b->model->points, 1);
    if (!s->mark) {
        peri__free_seat(w, s);
        return NULL;
    }
    if (w->seats == 0 && w->numbers == 0) peri__take_units(w, b->model);
    peri__set_units(w, b->model, s);
    peri__weigh_seat(s);
    return s;
}

/* Seats a body: room for it, then its contact as declared for all, then who is near it. It is to leave again where that fails. */
static int32_t peri__seat_body(peri_world *w, peri_body *b) {
    const int64_t n = w->seats;
    const int room = peri__grow(&w->memory, &w->seat, &w->seat_capacity, n + 1, sizeof(peri__seat *))
                  && peri__grow(&w->memory, &w->touch, &w->touch_capacity, n * (n + 1) / 2, sizeof *w->touch);
    peri__seat *s = room ? peri__new_seat(w, b) : NULL;
    if (!s) return peri__world_fail(w, PERI_ERROR_MEMORY, "body", -1, 0.0);
    w->seat[w->seats++] = s;
    b->seat = s;
    peri__carry_ledger(s, 1.0);
    int32_t status = PERI_OK;
    for (int64_t k = 0; k < n && status == PERI_OK; ++k) status = peri__declare_between(w, n, k, w->common_on ? &w->common : NULL);
    if (status == PERI_OK) status = peri__fit_or_tell(w);
    if (status == PERI_OK && !peri__note_born(w)) status = peri__world_fail(w, PERI_ERROR_MEMORY, "body", -1, 0.0);
    w->listed = 0;
    return status;
}

PERI_API int32_t peri_world_add(peri_world *w, peri_body *b) {
    PERI_NEED_STILL(w);
    if (!b || b->seat) return peri__world_fail(w, PERI_ERROR_ARGUMENT, "body", -1, 0.0);
    if (!b->model) return peri__world_fail(w, PERI_ERROR_ORDER, "peri_build", -1, 0.0);
    if (b->running) return peri__world_fail(w, PERI_ERROR_ORDER, "peri_unlock", -1, 0.0);
    if (b->model->part) return peri__world_fail(w, PERI_ERROR_PART, "body", -1, 0.0);
    if (w->dim > 0 && b->dim != w->dim) return peri__world_fail(w, PERI_ERROR_CHOICE, "space", -1, b->desc.space);
    (void)peri__ensure(b, PERI__STALE_CONSTANTS);
    const int32_t status = peri__seat_body(w, b);
    if (status == PERI_OK) {
        w->numbers += b->model->points;
        return PERI_OK;
    }
    const peri_error error = w->error;
    peri__leave_world(b);
    (void)peri__fit_or_tell(w);
    if (w->numbers == 0) w->dim = 0;
    w->error = error;
    return status;
}

PERI_API int32_t peri_world_remove(peri_world *w, peri_body *b) {
    PERI_NEED_STILL(w);
    if (peri__seat_of(w, b, "body") < 0) return w->error.code;
    peri__leave_world(b);
    return peri__fit_or_tell(w);
}

PERI_API int64_t peri_world_asleep(const peri_world *w, const peri_body *b) {
    if (!w || (b && (!b->seat || b->seat->world != w))) return PERI_ERROR_ARGUMENT;
    return b ? b->seat->island != 0 : w->sleepers;
}

PERI_API int32_t peri_world_get_force(peri_world *w, const peri_body *b, double *force) {
    double sum[3] = { 0.0, 0.0, 0.0 };
    if (!w) return PERI_ERROR_ARGUMENT;
    const int64_t at = peri__seat_of(w, b, "body");
    if (at < 0) return w->error.code;
    if (!force) return peri__world_fail(w, PERI_ERROR_ARGUMENT, "force", -1, 0.0);
    const peri__seat *s = w->seat[at];
    for (int64_t p = s->begin; p < s->end; ++p)
        for (int32_t d = 0; d < w->dim; ++d) sum[d] += w->roll.push[p * w->dim + d];
    for (int32_t d = 0; d < w->dim; ++d) force[d] = sum[d] * w->energy / w->length;
    return PERI_OK;
}
