/* SPDX-License-Identifier: MIT */
/* sleep.c - bodies of a world that rest fall asleep, and wake when touched.

   Bodies are near where a pair of their points is within half a skin of its touch (peri__is_near). Those that are near, directly or through
   others, are an island, and sleep and wake together: so who is awake is near nobody who sleeps, and the force on a sleeper stays as it is.
   Its velocity is set to zero, and what that takes is damping. After the drift of each step those wake that awake bodies have come near:
   they begin that step too, at rest, by the force with which they fell asleep; whatever pushes them they feel in that step. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__pace { /* how far a body is in a run                                                                  */
    peri__plan   plan;
    peri__half_way half;
    double       size; /* of the steps under way                                                                            */
} peri__pace;

typedef struct peri__tour { /* a run of a world                                                                            */
    peri_world *world;
    peri_advance_desc settings;
    peri__pace *pace;    /* [seats]                                                                                         */
    int64_t     leader;  /* the seat whose stable step is the least                                                         */
} peri__tour;

static peri_body *peri__nth_body(const peri_world *w, int64_t k) { return w->seat[k]->body; }

static double peri__next_time(const peri_body *b, const peri_advance_desc *r, const peri__plan *plan) {
    const int64_t full = plan->done < plan->full ? plan->done + 1 : plan->full;
    if (plan->done + 1 == plan->steps && r->steps == 0) return plan->end;
    return plan->start + ((double)full * plan->dt + (double)(plan->done + 1 - full) * plan->last) * b->model->time;
}

static int32_t peri__begin_step_of(peri__tour *t, int64_t k) {
    const peri_advance_desc *r = &t->settings;
    peri_body *b = peri__nth_body(t->world, k);
    peri__pace *pace = &t->pace[k];
    const double dt = peri__next_size(&pace->plan), next = peri__next_time(b, r, &pace->plan);
    return peri__world_heed(t->world, b, peri__begin_step(r, b, dt, next, r->damping * b->model->time, &pace->half));
}

/* After the drift, by lists that hold: wakes those whom somebody has come near, who then begin the step. Returns whether some did. */
static int peri__wake_touched(peri__tour *t, int32_t *status) {
    peri_world *w = t->world;
    if (w->sleepers == 0 || w->sleepers == w->seats) return 0;
    for (int64_t k = 0; k < w->seats; ++k) w->seat[k]->root = w->seat[k]->island; /* as they were */
    peri__place_world(w);
    if (!peri__wake_near(w)) return 0;
    for (int64_t k = 0; k < w->seats && *status >= 0; ++k) {
        if (!w->seat[k]->root || w->seat[k]->island) continue;
        peri_body *b = peri__nth_body(w, k);
        if (t->settings.integrator == PERI_INTEGRATOR_CENTRAL_DIFFERENCE)
            peri__stagger(b, t->pace[k].size, t->settings.damping * b->model->time);
        *status = peri__begin_step_of(t, k);
    }
    for (int64_t k = 0; k < w->seats && *status < 0; ++k) peri__changed(peri__nth_body(w, k), PERI__ACTION);
    return 1;
}

/* A step of a body that sleeps. */
static void peri__sleep_on(peri_body *b, double next) {
    b->now.time = next;
    b->now.steps++;
}

/* ---- who rests ----------------------------------------------------------------------------------------------------------- */

/* sums->a: the square of the largest speed. */
static void peri__speed_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = (const peri_body *)context;
    for (int64_t i = begin; i < end; ++i) {
        double square = 0.0;
        for (int32_t d = 0; d < b->dim; ++d) square += peri__square(peri__get_real(b->v, b->f32, d * b->model->stride + i));
        if (!(square <= sums->a)) sums->a = square;
    }
}

/* At the end of a step of seat k. */
static void peri__note_calm(const peri__tour *t, int64_t k) {
    peri__seat *s = t->world->seat[k];
    peri_body *b = s->body;
    const double most = t->world->sleep_speed / (b->model->length / b->model->time);
    int calm = !t->pace[k].half.broke;
    peri__for_points(b, b->model->points, 1, peri__speed_block, b, b->sums);
    for (int64_t n = 0; calm && n * PERI_BLOCK < b->model->points; ++n) calm = b->sums[n].a < peri__square(most);
    s->calm = calm ? s->calm + peri__next_size(&t->pace[k].plan) * b->model->time : 0.0;
}

/* Does nothing act on a body, nor go on in it, that varies with time? */
static int peri__may_sleep(const peri_body *b) {
    if (b->model->inelastic || b->overtime) return 0;
    for (int64_t k = 0; k < b->load_count; ++k) {
        const peri__load *load = &b->loads[k];
        if (load->kind == PERI__FREE) continue;
        if (load->fn || load->motion) return 0;
        for (int d = 0; load->kind == PERI__VELOCITY && d < 3; ++d)
            if (load->constant[d] != 0.0 || (load->rigid && load->turn[d] != 0.0)) return 0;
    }
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind && (b->obstacles[k].motion || b->obstacles[k].free)) return 0;
    return 1;
}

static int peri__rests(const peri_world *w, const peri__seat *s) {
    return !s->island && s->calm >= w->sleep_time && peri__may_sleep(s->body);
}

/* The least seat of each island goes to `root`, by the places of the last pass. */
static void peri__find_islands(peri_world *w) {
    const peri__roll *roll = &w->roll;
    for (int64_t k = 0; k < w->seats; ++k) w->seat[k]->root = k;
    for (int64_t p = 0; p < roll->members; ++p)
        for (int64_t e = roll->begin[p]; e < roll->begin[p + 1]; ++e) {
            const int64_t one = w->seat[roll->seat[p]]->root, other = w->seat[roll->seat[roll->other[e]]]->root;
            if (one == other || !peri__is_near(w, p, e)) continue;
            for (int64_t k = 0; k < w->seats; ++k)
                if (w->seat[k]->root == (one > other ? one : other)) w->seat[k]->root = one < other ? one : other;
        }
}

static int peri__island_rests(const peri_world *w, int64_t root) {
    int rests = 1;
    for (int64_t k = root; k < w->seats && rests; ++k)
        if (w->seat[k]->root == root) rests = peri__rests(w, w->seat[k]);
    return rests;
}

/* Is there an island that may fall asleep? By lists that may miss some who are near. */
static int peri__has_resting(peri_world *w) {
    int some = 0;
    if (!(w->sleep_speed > 0.0)) return 0;
    for (int64_t k = 0; k < w->seats && !some; ++k) some = peri__rests(w, w->seat[k]);
    if (!some) return 0;
    peri__find_islands(w);
    for (int64_t k = 0; k < w->seats; ++k)
        if (w->seat[k]->root == k && peri__island_rests(w, k)) return 1;
    return 0;
}

static void peri__fall_asleep(peri__seat *s, int64_t island) {
    peri_body *b = s->body;
    if (b->desc.ledger) b->now.ledger.damping += peri__kinetic_energy(b);
    memset(b->v, 0, peri__vector_bytes(b));
    s->island = island;
    s->placed = 0;
    s->world->sleepers++;
}

/* At a whole step of all: islands that rest fall asleep, by lists made anew; where memory is short nobody does. */
static void peri__lay_down(peri_world *w) {
    w->listed = 0;
    if (!peri__ready_world(w)) return;
    (void)peri__press_world(w);
    peri__find_islands(w);
    for (int64_t root = 0; root < w->seats; ++root) {
        if (w->seat[root]->root != root || !peri__island_rests(w, root)) continue;
        w->islands++;
        for (int64_t k = root; k < w->seats; ++k)
            if (w->seat[k]->root == root) peri__fall_asleep(w->seat[k], w->islands);
    }
}
