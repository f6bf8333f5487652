/* SPDX-License-Identifier: MIT */
/* force.c - the force of points that touch.

   A pair touches at r < d, d the least of the declared distance D and of the distance of both in the reference. With the spring

       k = kappa E V/(h D),    E, V: harmonic means of both moduli and volumes, h: the mean spacing of the body,

   its energy is 1/2 k (d - r)^2, and the points press each other by

       N = k (d - r) + clamp(c s, B k (d - r)),    s: the speed of approach,

   a dashpot that has at most a part B of the force of the spring: it neither jumps at the touch nor pulls. Where it is at its limit a
   piece of any mass leaves with sqrt((1 - B)/(1 + B)) of its speed. B is found so that points and light pieces leave with
   the restitution asked for (peri__loss_for). Friction is the least of mu N, of mu N over the speed that regularises it, and of c, times
   the tangential velocity. c = hold min(m_i, m_j)/(2 n), n the larger number of points that i or j touches: so no point loses its velocity
   faster than by the rate `hold`, which the stable step knows.

   A pair whose bond lives does not touch. Where a bond breaks while it is longer than at rest, contact makes no jump. By criteria of stress
   and of energy it may be shorter: the pair is then pressed at once, and what the spring holds comes out of what the bond had, and is not
   counted as fracture. Cuts by the caller may do the same, and the ledger counts them as his. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_HOLD 0.5 /* of the highest frequency                                                                           */

typedef struct peri__pair_touch { /* two points that touch                                                                */
    int64_t j;
    double  n[3]; /* from i to j                                                                                            */
    double  stiffness, pressed; /* k, d - r                                                                                 */
    const peri__touch *touch;
} peri__pair_touch;

/* Do member p and the other of entry e touch? */
static int peri__meet(const peri_body *b, int64_t p, int64_t e, peri__pair_touch *t) {
    const peri__contact *c = b->contact;
    const peri__model *m = b->model;
    const int64_t i = c->member[p];
    t->j = c->member[c->other[e]];
    const double square = peri__between(b, i, t->j, t->n), reach = sqrt(c->reach2[e]);
    if (!(square < c->reach2[e])) return 0;
    double r = sqrt(square);
    t->pressed = reach - r;
    if (!(r > 1e-6 * reach)) { /* at one place: apart as in the reference */
        peri__bond_of(m, b->f32, i, t->j, t->n);
        r = sqrt(peri__dot(t->n, t->n, m->dim));
    }
    for (int32_t d = 0; d < m->dim; ++d) t->n[d] /= r;
    t->touch = peri__touch_of(b, i, t->j);
    t->stiffness = t->touch->stiffness * (2.0 * m->volume[i] * m->volume[t->j] / (m->volume[i] + m->volume[t->j]));
    return 1;
}

typedef struct peri__toucher {
    peri_body *body;
    int32_t    presses;   /* forces are added to f                                                                           */
    double     half_step; /* dt/2                                                                                           */
} peri__toucher;

/* Springs. sums->a: energy, b: largest row sum over the mass. */
static void peri__press_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__toucher *s = (const peri__toucher *)context;
    peri_body *b = s->body;
    const peri__contact *c = b->contact;
    const peri__model *m = b->model;
    for (int64_t p = begin; p < end; ++p) {
        const int64_t i = c->member[p];
        double force[3] = { 0.0, 0.0, 0.0 }, row_sum = 0.0;
        c->touching[p] = 0;
        for (int64_t e = c->begin[p]; e < c->begin[p] + c->open[p]; ++e) {
            peri__pair_touch t;
            if (!peri__meet(b, p, e, &t)) continue;
            for (int32_t d = 0; d < m->dim; ++d) force[d] -= t.stiffness * t.pressed * t.n[d];
            sums->a += 0.25 * t.stiffness * t.pressed * t.pressed; /* the other end has the other half */
            row_sum += 2.0 * t.stiffness;
            c->touching[p]++;
        }
        if (c->touching[p] == 0) continue;
        row_sum /= peri__mass(b, i);
        if (row_sum > sums->b) sums->b = row_sum;
        for (int32_t d = 0; s->presses && d < m->dim; ++d) {
            const int64_t at = d * m->stride + i;
            peri__put_real(b->f, b->f32, at, peri__get_real(b->f, b->f32, at) + force[d] / m->volume[i]);
        }
    }
}

/* What dashpot and friction add to the force on the first of two points: v[dim], how the second moves from it, of which the part along n is
   `apart`, is left with the slip; most: what resists, over the velocity. */
static void peri__resist_motion(const peri__touch *touch, int32_t dim, const double *n, double *v, double apart, double spring, double most,
                                double *force) {
    const double limit = touch->loss * spring, dashpot = fmax(-limit, fmin(limit, -most * apart));
    double slip = 0.0;
    for (int32_t d = 0; d < dim; ++d) {
        v[d] -= apart * n[d];
        slip += v[d] * v[d];
        force[d] -= dashpot * n[d];
    }
    slip = sqrt(slip);
    if (!(touch->friction > 0.0 && slip > 0.0)) return;
    const double held = touch->friction * (spring + dashpot) / fmax(slip, touch->friction_speed);
    for (int32_t d = 0; d < dim; ++d) force[d] += fmin(held, most) * v[d];
}

/* What dashpot and friction of a pair add to the force on i. */
static void peri__resist(const peri_body *b, int64_t p, int64_t e, const peri__pair_touch *t, double *force) {
    const peri__contact *c = b->contact;
    const peri__model *m = b->model;
    const int64_t i = c->member[p];
    const double crowd = (double)(c->touching[p] > c->touching[c->other[e]] ? c->touching[p] : c->touching[c->other[e]]);
    const double most = 0.5 * c->hold * fmin(peri__mass(b, i), peri__mass(b, t->j)) / crowd, spring = t->stiffness * t->pressed;
    double v[3], apart = 0.0;
    for (int32_t d = 0; d < m->dim; ++d) {
        v[d] = peri__get_real(b->v, b->f32, d * m->stride + t->j) - peri__get_real(b->v, b->f32, d * m->stride + i);
        apart += v[d] * t->n[d];
    }
    peri__resist_motion(t->touch, m->dim, t->n, v, apart, spring, most, force);
}

/* Dashpots and friction. sums->a: what they took in the step, by the rule of loads.c. */
static void peri__resist_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__toucher *s = (const peri__toucher *)context;
    peri_body *b = s->body;
    const peri__contact *c = b->contact;
    const peri__model *m = b->model;
    for (int64_t p = begin; p < end; ++p) {
        const int64_t i = c->member[p];
        double force[3] = { 0.0, 0.0, 0.0 };
        for (int64_t e = c->begin[p]; c->touching[p] > 0 && e < c->begin[p] + c->open[p]; ++e) {
            peri__pair_touch t;
            if (peri__meet(b, p, e, &t)) peri__resist(b, p, e, &t, force);
        }
        for (int32_t d = 0; d < m->dim; ++d) {
            const int64_t at = d * m->stride + i;
            const double drag = force[d] / m->volume[i];
            if (drag == 0.0 && c->drag[at] == 0.0) continue;
            sums->a -= s->half_step * (c->drag[at] + drag) * peri__get_real(b->v, b->f32, at) * m->volume[i];
            c->drag[at] = drag;
            peri__put_real(b->f, b->f32, at, peri__get_real(b->f, b->f32, at) + drag);
        }
    }
}

/* The springs of all pairs, which make `touching` and `crowd`; to f where `presses`. Returns the energy. */
static double peri__press(peri_body *b, int32_t presses) {
    peri__contact *c = b->contact;
    peri__toucher toucher = { b, presses, 0.0 };
    peri__for_points(b, c->members, 4, peri__press_block, &toucher, b->sums);
    c->crowd = 0.0;
    for (int64_t k = 0; k * PERI_BLOCK < c->members; ++k)
        if (b->sums[k].b > c->crowd) c->crowd = b->sums[k].b;
    return peri__total(b->sums, c->members).a;
}

/* Adds the forces of contact to f, by lists that hold; dt > 0: counts what the step that ends here has lost. `resists`: with dashpots and
   friction. */
static void peri__apply_touch(peri_body *b, double dt, int resists) {
    peri__contact *c = b->contact;
    peri__toucher toucher = { b, 1, 0.5 * dt };
    (void)peri__press(b, 1);
    if (!c->drag || !resists) return;
    peri__for_points(b, c->members, 4, peri__resist_block, &toucher, b->sums);
    if (b->desc.ledger) b->now.ledger.damping += peri__total(b->sums, c->members).a;
}

/* ---- lists that hold ------------------------------------------------------------------------------------------------ */

/* Opens what slept and may touch now. */
static void peri__wake_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = (const peri_body *)context;
    const peri__contact *c = b->contact;
    (void)sums;
    for (int64_t p = begin; p < end; ++p)
        for (int64_t e = c->begin[p] + c->open[p]; e < c->begin[p + 1]; ++e)
            if (!peri__sleeps(b, c->member[p], c->member[c->other[e]], c->bond[e])) peri__open_entry(c, p, e);
}

/* Makes lists that hold for the body as it is: 0 where memory is short; the old ones, if any, then nearly do. */
static int peri__ready_contact(peri_body *b) {
    peri__contact *c = b->contact;
    const int died = c->dead != b->now.broken + b->now.cut, joined = died && peri__mark_exposed(b, c->mark);
    c->dead = b->now.broken + b->now.cut;
    if (c->listed && died) peri__for_points(b, c->members, 2, peri__wake_block, b, NULL);
    if (c->listed && !joined && !peri__has_moved(b)) return 1;
    c->listed = c->listed && !joined; /* where no memory is left, of lists that lack points nothing is to be read */
    return peri__search_contact(b);
}

/* sums->a: the energy of springs half a step ago, to its second order, at the velocity of that moment. */
static void peri__store_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__toucher *s = (const peri__toucher *)context;
    const peri_body *b = s->body;
    const peri__contact *c = b->contact;
    for (int64_t p = begin; p < end; ++p)
        for (int64_t e = c->begin[p]; e < c->begin[p] + c->open[p]; ++e) {
            peri__pair_touch t;
            double apart = 0.0;
            if (!peri__meet(b, p, e, &t)) continue;
            for (int32_t d = 0; d < b->dim; ++d) {
                const int64_t at = d * b->model->stride;
                apart += t.n[d] * (peri__get_real(b->v, b->f32, at + t.j) - peri__get_real(b->v, b->f32, at + c->member[p]));
            }
            sums->a += t.stiffness * t.pressed * (0.25 * t.pressed + 0.5 * s->half_step * apart);
        }
}

static double peri__stored_energy(peri_body *b, double dt) {
    peri__toucher toucher = { b, 0, 0.5 * dt };
    if (!b->contact->listed) return 0.0;
    peri__for_points(b, b->contact->members, 4, peri__store_block, &toucher, b->sums);
    return peri__total(b->sums, b->contact->members).a;
}

/* peri__ready_contact after bonds broke in a step of dt. The kick that follows gives pairs that touch for that half a step of their force,
   as if all had met in the middle of the step: the energy that they had then is not lost with the bonds. */
static int peri__ready_after_breaks(peri_body *b, double dt) {
    const double before = peri__stored_energy(b, dt);
    if (!peri__ready_contact(b)) return 0;
    b->now.ledger.fracture -= peri__stored_energy(b, dt) - before;
    return 1;
}

/* Energy of all that touches, by lists that hold. */
static double peri__contact_energy(peri_body *b) { return b->contact && b->contact->listed ? peri__press(b, 0) : 0.0; }

/* ---- what it may do to the step --------------------------------------------------------------------------------------- */

/* The largest stable step, where lambda bounds the square of the highest frequency without contact. The dashpots follow the velocity of
   half a step before: with the rate g, lambda dt^2/4 + g dt/2 <= 1; at their limits they are springs. */
static double peri__step_with_touch(double touch, double grown, double hold, double lambda) {
    const double half = 0.5 * hold;
    const double linear = 2.0 / (half + sqrt(half * half + lambda + touch)), limited = 2.0 / sqrt(lambda + grown);
    return linear < limited ? linear : limited;
}

static double peri__step_with_contact(const peri__contact *c, double lambda) {
    const double touch = c->crowd > c->bound ? c->crowd : c->bound;
    return peri__step_with_touch(touch, c->growth * touch, c->hold, lambda);
}

/* The part of its speed with which a mass leaves a spring k with this dashpot; mean over the moments of a step at which it comes. */
static double peri__rebound(double k, double c, double mass, double dt, double loss) {
    double left = 0.0;
    for (int phase = 0; phase < 5; ++phase) {
        double pressed = dt * (phase - 4.5) / 5.0, v = 1.0;
        for (int step = 0; step < 100000; ++step) {
            pressed += dt * v;
            if (pressed < 0.0 && v < 0.0) break;
            const double spring = pressed > 0.0 ? k * pressed : 0.0;
            v -= dt / mass * (spring + fmax(-loss * spring, fmin(loss * spring, c * v)));
        }
        left -= v / 5.0;
    }
    return left;
}

/* Neighbours that a point of a surface touches, of points of this spacing: two in the plane, four in space, as where lattices meet off
   their sites; more where the distance is longer. What a state has beyond that is seen as it comes: `crowd`. */
static double peri__assumed_touching(int32_t dim, double distance, double spacing) {
    const double wide = fmax(1.0, distance / spacing);
    return dim == 2 ? 2.0 * wide : 4.0 * wide * wide;
}

/* B for a restitution, of points of the body's mean kind; more than 1 where it is out of reach, with what is in reach to *least. */
static double peri__loss_for(double restitution, double k, double hold, double dt, double *least) {
    const double mass = 1.0, c = 0.5 * hold; /* of the pair: two layers of points on either side */
    double lo = 0.0, hi = 1.0;
    *least = 0.0;
    if (restitution >= 1.0) return 0.0;
    *least = peri__rebound(k, c, mass, dt, 1.0);
    if (restitution < *least) return 2.0;
    for (int n = 0; n < 30; ++n) {
        const double middle = 0.5 * (lo + hi);
        if (peri__rebound(k, c, mass, dt, middle) > restitution) lo = middle;
        else hi = middle;
    }
    return 0.5 * (lo + hi);
}
