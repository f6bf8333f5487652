/* SPDX-License-Identifier: MIT */
/* between.c - the force of points of different bodies of a world that touch: the law of force.c, with the harmonic means of both moduli and
   volumes, D = h = the mean of both spacings unless a distance is declared, and d the least of D and of the distance that both had when
   the later body came. The rate at which dashpots and friction take velocity from a point is at most that of either body. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__presser {
    peri__seat *seat;
    double      half_step; /* dt/2                                                                                          */
} peri__presser;

typedef struct peri__encountered { /* two points that touch, in the units of the world                                         */
    double n[3], stiffness, pressed; /* from the first to the second; k, d - r                                             */
    const peri__touch *touch;
} peri__encountered;

static void peri__place_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__seat *s = (const peri__seat *)context;
    const peri_body *b = s->body;
    const peri__roll *roll = &s->world->roll;
    (void)sums;
    for (int64_t p = s->begin + begin; p < s->begin + end; ++p) {
        peri__locate(s, roll->point[p], &roll->place[p * b->dim]);
        for (int32_t d = 0; d < b->dim; ++d)
            roll->motion[p * b->dim + d] = s->speed * peri__get_real(b->v, b->f32, d * b->model->stride + roll->point[p]);
    }
}

/* Does member p touch that of entry e? */
static int peri__encounter(const peri_world *w, int64_t p, int64_t e, peri__encountered *t) {
    const peri__roll *roll = &w->roll;
    const int64_t q = roll->other[e];
    double square = 0.0;
    for (int32_t d = 0; d < w->dim; ++d) {
        t->n[d] = roll->place[q * w->dim + d] - roll->place[p * w->dim + d];
        square += t->n[d] * t->n[d];
    }
    if (!(square < roll->reach2[e])) return 0;
    const peri__seat *s = w->seat[roll->seat[p]], *other = w->seat[roll->seat[q]];
    if (!(s->mark[roll->point[p]] & other->mark[roll->point[q]] & PERI__EXPOSED)) return 0;
    const double reach = sqrt(roll->reach2[e]);
    double r = sqrt(square);
    t->pressed = reach - r;
    if (!(r > 1e-6 * reach)) { /* at one place: along an axis */
        t->n[0] = p < q ? 1.0 : -1.0;
        for (int32_t d = 1; d < w->dim; ++d) t->n[d] = 0.0;
        r = 1.0;
    }
    for (int32_t d = 0; d < w->dim; ++d) t->n[d] /= r;
    t->touch = &w->touch[peri__seats_of(roll->seat[p], roll->seat[q])];
    t->stiffness = t->touch->stiffness * peri__mean_of_two(roll->young[p], roll->young[q])
                 * peri__mean_of_two(roll->volume[p], roll->volume[q]);
    return 1;
}

/* Springs. sums->a: energy, b: largest row sum over the mass, n: how many touch. */
static void peri__press_others_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__seat *s = (const peri__seat *)context;
    const peri_world *w = s->world;
    const peri__roll *roll = &w->roll;
    for (int64_t p = s->begin + begin; p < s->begin + end; ++p) {
        double force[3] = { 0.0, 0.0, 0.0 }, row_sum = 0.0;
        roll->touching[p] = 0;
        for (int64_t e = roll->begin[p]; e < roll->begin[p + 1]; ++e) {
            peri__encountered t;
            if (!peri__encounter(w, p, e, &t)) continue;
            for (int32_t d = 0; d < w->dim; ++d) force[d] -= t.stiffness * t.pressed * t.n[d];
            sums->a += 0.25 * t.stiffness * t.pressed * t.pressed; /* the other end has the other half */
            row_sum += 2.0 * t.stiffness;
            roll->touching[p]++;
        }
        memcpy(&roll->spring[p * w->dim], force, (size_t)w->dim * sizeof *force);
        row_sum /= roll->mass[p];
        if (row_sum > sums->b) sums->b = row_sum;
        sums->n += roll->touching[p] > 0;
    }
}

/* Is entry e of member p within half a skin of its touch? Lists that were made when one of both had come to its place have all that are. */
static int peri__is_near(const peri_world *w, int64_t p, int64_t e) {
    const peri__roll *roll = &w->roll;
    const int64_t q = roll->other[e], dim = w->dim;
    const double skin = PERI_SKIN * w->touch[peri__seats_of(roll->seat[p], roll->seat[q])].distance;
    return peri__square_between(w, &roll->place[p * dim], &roll->place[q * dim]) < peri__square(sqrt(roll->reach2[e]) + 0.5 * skin);
}

/* Wakes those who sleep and have somebody near who does not. Returns how many bodies that are. */
static int64_t peri__wake_near(peri_world *w) {
    const peri__roll *roll = &w->roll;
    const int64_t sleepers = w->sleepers;
    for (int64_t a = 0; a < w->seats; ++a)
        for (int64_t p = w->seat[a]->begin; !w->seat[a]->island && p < w->seat[a]->end; ++p)
            for (int64_t e = roll->begin[p]; e < roll->begin[p + 1]; ++e) {
                peri__seat *other = w->seat[roll->seat[roll->other[e]]];
                if (other->island && peri__is_near(w, p, e)) peri__rouse(other);
            }
    return sleepers - w->sleepers;
}

static void peri__place_world(peri_world *w) {
    for (int64_t a = 0; a < w->seats; ++a) {
        peri__seat *s = w->seat[a];
        if (s->end > s->begin && !s->placed) peri__for_points(s->body, s->end - s->begin, 1, peri__place_block, s, NULL);
    }
}

/* Springs of all pairs, and the crowds, by lists that hold. Returns the energy. Nobody who is awake is near those who sleep, so that
   what the first pass finds for them holds until they wake or the lists are made anew. */
static double peri__press_world(peri_world *w) {
    double energy = 0.0;
    peri__place_world(w);
    if (w->sleepers > 0 && w->sleepers < w->seats) (void)peri__wake_near(w);
    for (int64_t a = 0; a < w->seats; ++a) {
        peri__seat *s = w->seat[a];
        const int64_t members = s->end - s->begin;
        double crowd = 0.0;
        if (s->placed) {
            energy += s->pressed;
            continue;
        }
        s->placed = s->island != 0;
        s->pressed = 0.0;
        if (members > 0) {
            peri__for_points(s->body, members, 4, peri__press_others_block, s, s->body->sums);
            s->pressed = peri__total(s->body->sums, members).a;
            energy += s->pressed;
        }
        for (int64_t k = 0; k * PERI_BLOCK < members; ++k) crowd = fmax(crowd, s->body->sums[k].b);
        s->crowd = crowd * peri__square(s->time);
    }
    return energy;
}

/* What dashpots and friction add to the force on member p. */
static void peri__resist_others(const peri_world *w, int64_t p, double *force) {
    const peri__roll *roll = &w->roll;
    const peri__seat *s = w->seat[roll->seat[p]];
    for (int64_t e = roll->begin[p]; e < roll->begin[p + 1]; ++e) {
        const int64_t q = roll->other[e];
        peri__encountered t;
        if (!peri__encounter(w, p, e, &t)) continue;
        const peri__seat *other = w->seat[roll->seat[q]];
        const double rate = fmin(s->hold / s->time * roll->mass[p], other->hold / other->time * roll->mass[q]);
        const double crowd = (double)(roll->touching[p] > roll->touching[q] ? roll->touching[p] : roll->touching[q]);
        double v[3], apart = 0.0;
        for (int32_t d = 0; d < w->dim; ++d) {
            v[d] = roll->motion[q * w->dim + d] - roll->motion[p * w->dim + d];
            apart += v[d] * t.n[d];
        }
        peri__resist_motion(t.touch, w->dim, t.n, v, apart, t.stiffness * t.pressed, 0.5 * rate / crowd, force);
    }
}

/* Adds the force on the members to f. sums->a: its work in the step, b: what dashpots and friction took, by the rule of loads.c;
   n: how many were pushed. */
static void peri__push_block_of_body(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__presser *presser = (const peri__presser *)context;
    const peri__seat *s = presser->seat;
    const peri_world *w = s->world;
    const peri__roll *roll = &w->roll;
    peri_body *b = s->body;
    for (int64_t p = s->begin + begin; p < s->begin + end; ++p) {
        double drag[3] = { 0.0, 0.0, 0.0 };
        const double own = s->length / s->energy / b->model->volume[roll->point[p]]; /* from a force of the world to a density of b */
        if (w->resists && roll->touching[p] > 0) peri__resist_others(w, p, drag);
        for (int32_t d = 0; d < w->dim; ++d) {
            const int64_t at = d * b->model->stride + roll->point[p], k = p * w->dim + d;
            const double push = roll->spring[k] + drag[d];
            if (push == 0.0 && roll->push[k] == 0.0) continue;
            sums->a += presser->half_step * (roll->push[k] + push) * roll->motion[k];
            sums->b -= presser->half_step * (roll->drag[k] + drag[d]) * roll->motion[k];
            roll->push[k] = push;
            roll->drag[k] = drag[d];
            if (push == 0.0) continue;
            peri__put_real(b->f, b->f32, at, peri__get_real(b->f, b->f32, at) + own * push);
            sums->n++;
        }
    }
}

/* Adds what others do to a body to its force, after peri__press_world; dt > 0, of the world: counts the work of the step that ends here. */
static void peri__push_body(peri__seat *s, double dt) {
    peri__presser presser = { s, 0.5 * dt };
    peri_body *b = s->body;
    const int64_t members = s->end - s->begin;
    if (members > 0) peri__for_points(b, members, 4, peri__push_block_of_body, &presser, b->sums);
    const peri__sums total = peri__total(b->sums, members);
    b->now.pushed = total.n > 0;
    if (!b->desc.ledger) return;
    b->now.ledger.external += total.a / s->energy;
    b->now.ledger.others += total.a / s->energy;
    b->now.ledger.rubbed += total.b / s->energy;
}

/* Has the force of a body what others do to it as it and they are? After peri__press_world. */
static int peri__is_pushed_as_now(const peri__seat *s) {
    const peri__roll *roll = &s->world->roll;
    int pushed = 0;
    for (int64_t k = s->begin * s->world->dim; k < s->end * s->world->dim; ++k) {
        if (roll->push[k] != roll->spring[k] + roll->drag[k]) return 0;
        pushed |= roll->push[k] != 0.0;
    }
    return pushed == s->body->now.pushed;
}

/* ---- what it may do to the step ------------------------------------------------------------------------------------------ */

/* The largest row sum that contact with c is taken to give a point of s, in the units of s. */
static double peri__bound_by(const peri_world *w, const peri__seat *s, const peri__seat *c, const peri__touch *t) {
    const double young = peri__mean_of_two(s->young, c->young), volumes = 2.0 * c->most_volume / (s->least_volume + c->most_volume);
    const double row = 2.0 * peri__assumed_touching(w->dim, t->distance, c->spacing) * t->stiffness * young * volumes / s->least_density;
    return row * peri__square(s->time);
}

/* The largest stable step of a body with its contact, where lambda bounds the square of the highest frequency without it. */
static double peri__step_touched(const peri_body *b, double lambda) {
    const peri__contact *c = b->contact;
    const peri__seat *s = b->seat && b->seat->world->running ? b->seat : NULL;
    double touch = 0.0, grown = 0.0, hold = 0.0;
    if (!s) return c ? peri__step_with_contact(c, lambda) : 2.0 / sqrt(lambda);
    if (c) {
        touch = fmax(c->crowd, c->bound);
        grown = c->growth * touch;
        hold = c->hold;
    }
    return peri__step_with_touch(touch + fmax(s->crowd, s->bound), grown + s->growth * fmax(s->crowd, s->bound), hold + s->hold, lambda);
}

static double peri__bonds_of(const peri_body *b) { return fmax(b->largest_row_sum, b->model->row_sum * b->row_sum_factor); }

/* Fits dashpots of a pair to its restitution; 0 where that is out of reach: *value is what is not. */
static int peri__fit_pair(const peri_world *w, int64_t a, int64_t c, double *value) {
    peri__seat *s = w->seat[a], *o = w->seat[c];
    peri__touch *t = &w->touch[peri__seats_of(a, c)];
    const double masses = peri__mean_of_two(s->mean_mass, o->mean_mass); /* twice the reduced one: two layers of points on either side */
    const double volumes = peri__mean_of_two(s->mean_mass / s->least_density, o->mean_mass / o->least_density);
    const double k = t->stiffness * peri__mean_of_two(s->young, o->young) * volumes / masses;
    const double rate = fmin(s->hold / s->time * s->mean_mass, o->hold / o->time * o->mean_mass) / masses;
    const double mine = peri__step_with_touch(s->bound, s->bound, s->hold, peri__bonds_of(s->body)) * s->time;
    const double others = peri__step_with_touch(o->bound, o->bound, o->hold, peri__bonds_of(o->body)) * o->time;
    t->loss = peri__loss_for(t->desc.restitution, k, rate, 0.9 * fmin(mine, others), value);
    if (t->loss > 1.0) return 0;
    s->growth = fmax(s->growth, 1.0 + t->loss);
    o->growth = fmax(o->growth, 1.0 + t->loss);
    return 1;
}

/* Fills in the numbers of all pairs, which have their desc and distance. 0 where a restitution is out of reach, of seats *a and *c. */
static int peri__fit_world(peri_world *w, int64_t *a, int64_t *c, double *value) {
    w->resists = 0;
    for (int64_t k = 0; k < w->seats; ++k) {
        peri__seat *s = w->seat[k];
        s->bound = s->hold = 0.0;
        s->growth = 1.0;
    }
    for (*a = 1; *a < w->seats; ++*a)
        for (*c = 0; *c < *a; ++*c) {
            peri__seat *s = w->seat[*a], *o = w->seat[*c];
            peri__touch *t = &w->touch[peri__seats_of(*a, *c)];
            if (!t->on) continue;
            t->stiffness = t->desc.stiffness / (0.5 * (s->spacing + o->spacing) * t->distance);
            s->bound = fmax(s->bound, peri__bound_by(w, s, o, t));
            o->bound = fmax(o->bound, peri__bound_by(w, o, s, t));
            w->resists = w->resists || t->desc.friction > 0.0 || t->desc.restitution < 1.0;
        }
    for (int64_t k = 0; w->resists && k < w->seats; ++k)
        w->seat[k]->hold = PERI_HOLD * sqrt(peri__bonds_of(w->seat[k]->body) + w->seat[k]->bound);
    for (*a = 1; *a < w->seats; ++*a)
        for (*c = 0; *c < *a; ++*c)
            if (w->touch[peri__seats_of(*a, *c)].on && !peri__fit_pair(w, *a, *c, value)) return 0;
    return 1;
}
