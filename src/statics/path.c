/* SPDX-License-Identifier: MIT */
/* path.c - fracture control: the load factor at which the next bond just meets its criterion, break by break, up or down
   (sequentially linear analysis: Rots 2001; DeJong, Hendriks, Rots 2008).

   With the bonds as they are the equilibria at neighbouring factors lie on a line, u + rate (factor' - factor): in linear geometry exactly
   and everywhere, where all that acts is proportional to the factor through u = 0. The excess of a bond is convex along it, so the factors
   at which no bond is over its limit are an interval; its end towards load_to is the one sought.

   From one such equilibrium to the next the body passes through no other: a bond that broke gives up its force as the factor goes on, along
   a straight line. By reciprocity the work of the loads then is the change of the elastic energy and 1/2 f e' of every bond that broke, f
   its force before, e' its extension after: that is the energy of fracture. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_MET 1e-7   /* how near to one the largest excess is to come                                                 */
#define PERI_TRIES 40   /* of the search along a line                                                                    */
#define PERI_CORRECTIONS 8 /* lines, one after the other, where equilibria lie on none                                   */

typedef struct peri__path {
    peri__solver *s;
    double  begin, end;     /* factors                                                                                    */
    double  before, after;  /* elastic energy at the last event, before and after its bonds broke                         */
    int64_t events;         /* rounds of breaking                                                                         */
    int32_t proportional;   /* 1: the equilibrium is proportional to the factor                                           */
    int32_t open;           /* 1: bonds have broken since the last event                                                  */
    int32_t arrested;       /* 1: no bond meets its criterion up to the end, and the last that broke have been let go here */
} peri__path;

static int peri__is_proportional(const peri_body *b) {
    if (!peri__is_linear(b) || b->eigenstrain) return 0;
    for (int64_t l = 0; l < b->load_count; ++l) {
        const peri__load *load = &b->loads[l];
        if (load->kind != PERI__FREE && (load->fn || load->kind == PERI__VELOCITY)) return 0;
    }
    return 1;
}

/* rate = (u - from)/way; parts that were left where they are stay. from may be NULL: 0. */
static void peri__take_rate(peri__solver *s, const void *from, double way) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            const int64_t at = d * m->stride + i;
            const double moved = peri__get_real(b->u, b->f32, at) - (from ? peri__get_real(from, b->f32, at) : 0.0);
            peri__put_real(s->rate, b->f32, at, s->part_of[i] == PERI_LOST ? 0.0 : moved / way);
        }
}

/* u = s->before + way rate, s->before being u at the factor `from`. */
static void peri__slide(peri__solver *s, double way) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t i = 0; i < m->points; ++i) {
            const int64_t at = d * m->stride + i;
            peri__put_real(b->u, b->f32, at, peri__get_real(s->before, b->f32, at) + way * peri__get_real(s->rate, b->f32, at));
        }
}

/* The largest excess at the present displacements; energies and the work on bonds are brought up to them first. */
static double peri__level(peri__solver *s) {
    peri_body *b = s->body;
    if (b->model->seen_by & (PERI__BY_WORK | PERI__BY_NODE_ENERGY)) {
        peri__operands operands = peri__operands_of(b);
        operands.working = (b->model->seen_by & PERI__BY_WORK) != 0;
        operands.f = s->k.q; /* b->f stays that of the equilibrium */
        peri__bond_forces(b, &operands);
        s->report.passes++;
    }
    return peri__most_excess(b);
}

/* The same a way further along the rate, in factors, from s->before. */
static double peri__level_at(peri__solver *s, double way) {
    peri__slide(s, way);
    return peri__level(s);
}

static int peri__is_met(double level) { return fabs(level - 1.0) <= 0.1 * PERI_MET; }

/* Where the largest excess is one, between a way `in` where it is less and one `out` where it is more. */
static double peri__close_in(peri__solver *s, double in, double level_in, double out, double level_out) {
    for (int k = 0; k < PERI_TRIES; ++k) {
        const double way = in + (k % 3 == 2 ? 0.5 : (1.0 - level_in) / (level_out - level_in)) * (out - in), level = peri__level_at(s, way);
        if (peri__is_met(level)) return way;
        if (level > 1.0) out = way, level_out = level;
        else in = way, level_in = level;
    }
    return in;
}

/* The way to where the largest excess, `here` at s->before, is one: the furthest towards the end, `reach` away, and no further. NaN: it
   is more than one everywhere. Proportional to the factor it falls and rises with it, and so the first guess is that it does. */
static double peri__seek(const peri__path *path, double here, double factor, double reach) {
    peri__solver *s = path->s;
    const int inside = here <= 1.0;
    const double ahead = path->end - path->begin, guess = here > 0.0 ? factor / here - factor : reach;
    double last = 0.0, level_last = here, way = guess;
    if (path->proportional && factor != 0.0 && (!inside || factor * ahead > 0.0)) return (guess - reach) * ahead < 0.0 ? guess : reach;
    if (inside && !(guess * ahead > 0.0 && (guess - reach) * ahead < 0.0)) way = reach;
    if (!inside && !(guess * ahead < 0.0)) way = -ahead;
    for (int k = 0; k < PERI_TRIES; ++k) {
        const double level = peri__level_at(s, way);
        if (peri__is_met(level) || (level <= 1.0 && way == reach)) return way;
        if (inside && level > 1.0) return peri__close_in(s, last, level_last, way, level);
        if (!inside && level <= 1.0) return peri__close_in(s, way, level, last, level_last);
        if (!inside && !(level < level_last)) return (double)NAN; /* it is convex: from here on it rises */
        const double further = way + (1.0 - level) * (way - last) / (level - level_last);
        last = way;
        level_last = level;
        way = further;
        if (inside && !((way - last) * ahead > 0.0 && (way - reach) * ahead < 0.0)) way = reach;
        if (!(fabs(way) <= 1e9 * (fabs(ahead) + fabs(factor)))) break;
    }
    return inside ? last : (double)NAN;
}

/* What the loads did since the last equilibrium that counts, and the body has not stored: to *account. */
static void peri__settle(peri__path *path, double *account) {
    peri__solver *s = path->s;
    peri_body *b = s->body;
    const double external = b->now.ledger.external;
    peri__count_work(s, s->from);
    const double energy = peri__static_energy(b);
    if (path->open) *account += b->now.ledger.external - external - (energy - path->before);
    path->before = energy;
    path->open = 0;
    if (s->from) memcpy(s->from, b->u, peri__vector_bytes(b));
}

/* The bonds that broke are let go at this factor, as no event follows: what they held is fracture, what springs free damping. */
static void peri__let_go(peri__path *path) {
    peri_body *b = path->s->body;
    if (!path->open) return;
    b->now.ledger.fracture += path->before - path->after;
    path->before = path->after;
    peri__settle(path, &b->now.ledger.damping);
}

/* on_step has changed the bonds, or what acts. */
static int32_t peri__find_anew(peri__path *path) {
    peri__solver *s = path->s;
    s->disturbed = 0;
    path->proportional = peri__is_proportional(s->body);
    int32_t status = peri__set_factor(s, s->body->now.load_factor);
    path->before = path->after = peri__static_energy(s->body);
    path->open = 1;
    if (status == PERI_OK) status = peri__equilibrium(s, PERI__ANEW);
    if (status == PERI_OK) peri__let_go(path);
    return status;
}

/* From the equilibrium at the present factor to that at which the most overloaded bond just meets its criterion, or to the end. Where bonds
   have broken and no other is to follow it stays. So it does where the limit is passed at every factor, by a part of the loads that does
   not go with it: *level is then above one. */
static int32_t peri__to_next_break(peri__path *path, double *level) {
    peri__solver *s = path->s;
    peri_body *b = s->body;
    *level = peri__level(s);
    path->arrested = 0;
    for (int k = 0; k < PERI_CORRECTIONS; ++k) {
        const double factor = b->now.load_factor, reach = path->end - factor;
        if (path->proportional && factor != 0.0) peri__take_rate(s, NULL, factor);
        memcpy(s->before, b->u, peri__vector_bytes(b));
        const double way = peri__seek(path, *level, factor, reach);
        peri__slide(s, 0.0);
        path->arrested = path->open && way == reach;
        if (!(way == way) || way == reach) peri__let_go(path);
        if (!(way == way) || path->arrested) return PERI_OK;
        peri__slide(s, way);
        int32_t status = peri__set_factor(s, way == reach ? path->end : factor + way);
        if (status == PERI_OK) status = peri__equilibrium(s, PERI__AS_PREPARED);
        if (status != PERI_OK) return status;
        if (fabs(way) > 1e-6 * (fabs(factor) + fabs(reach))) peri__take_rate(s, s->before, way);
        *level = peri__level(s);
        if (fabs(*level - 1.0) <= PERI_MET || (way == reach && *level <= 1.0)) break;
    }
    return PERI_OK;
}

/* As peri__show_settled of load steps; until bonds are over their limit for those that on_step has cut. */
static int32_t peri__show_first(peri__path *path, double *level) {
    peri__solver *s = path->s;
    int32_t status = peri__show_step(s, 0);
    for (int64_t rounds = 0; status == PERI_OK && s->cut; ++rounds) {
        if (rounds >= s->settings->breaks) return peri__fail_step(s, PERI_ERROR_CONVERGENCE, "breaks", -1, (double)s->report.broken);
        status = peri__find_anew(path);
        if (status == PERI_OK && peri__may_break(s)) *level = peri__level(s);
        if (status != PERI_OK || *level > 1.0) break;
        status = peri__show_step(s, 1);
    }
    return status;
}

/* Up to the first factor of the load steps at which a bond is over its limit, in *level. The rate is that of the last step. */
static int32_t peri__to_first(peri__path *path, double *level) {
    peri__solver *s = path->s;
    peri_body *b = s->body;
    const int64_t steps = s->settings->steps;
    int32_t status = peri__set_factor(s, path->begin);
    if (status == PERI_OK) status = peri__equilibrium(s, PERI__ANEW);
    if (status == PERI_OK) peri__settle(path, &b->now.ledger.damping);
    for (int64_t k = 1; k <= steps && status == PERI_OK; ++k) {
        if (k > 1 && b->now.stale & PERI__STALE_BALANCE) status = peri__find_anew(path);
        if (status != PERI_OK) break;
        const double from = b->now.load_factor, part = (double)k / (double)steps;
        const double to = k < steps ? path->begin + (path->end - path->begin) * part : path->end;
        memcpy(s->before, b->u, peri__vector_bytes(b));
        status = peri__set_factor(s, to);
        if (status == PERI_OK) status = peri__equilibrium(s, PERI__AS_PREPARED);
        if (status != PERI_OK) break;
        if (to != from) peri__take_rate(s, s->before, to - from);
        *level = peri__may_break(s) ? peri__level(s) : 0.0;
        if (*level > 1.0) break;
        peri__settle(path, &b->now.ledger.damping);
        status = peri__show_first(path, level);
        if (status == PERI_OK) status = peri__heed_callbacks(b);
        if (*level > 1.0) break;
    }
    return status;
}

/* Breaks the bonds that meet their criterion here, and those that are as near to it, and finds the equilibrium of the others. */
static int32_t peri__event(peri__path *path, double level) {
    peri__solver *s = path->s;
    peri_body *b = s->body;
    const double least = level * s->settings->criticality * (1.0 - 2.0 * PERI_EQUAL(b));
    peri__note_stresses(b, NULL); /* the level was found on the way here */
    (void)peri__break_static(s, level, least < 1.0 ? least : 1.0);
    path->after = peri__static_energy(b);
    path->open = 1;
    path->events++;
    int32_t status = peri__equilibrium(s, PERI__AFTER_BREAK);
    if (status == PERI_ERROR_LOOSE) b->now.ledger.fracture += path->before - path->after;
    return status;
}

static int32_t peri__follow(peri__solver *s) {
    peri_body *b = s->body;
    peri__path path;
    double level = 0.0;
    memset(&path, 0, sizeof path);
    path.s = s;
    path.begin = s->load_from;
    path.end = s->settings->load_to;
    path.proportional = peri__is_proportional(b);
    int32_t status = peri__to_first(&path, &level);
    if (status != PERI_OK || !(level > 1.0)) return status;
    for (status = peri__to_next_break(&path, &level); status == PERI_OK; status = peri__to_next_break(&path, &level)) {
        peri__settle(&path, &b->now.ledger.fracture);
        status = peri__show_step(s, 0);
        if (status == PERI_OK) status = peri__heed_callbacks(b);
        const int changed = (b->now.stale & PERI__STALE_BALANCE) != 0;
        if (status != PERI_OK || (!path.arrested && !changed && b->now.load_factor == path.end && level <= 1.0)) break;
        if (changed) status = peri__find_anew(&path);
        else if (path.events >= s->settings->breaks) s->report.ended = PERI_ENDED_BREAKS;
        else if (!path.arrested) status = peri__event(&path, level);
        if (status != PERI_OK || s->report.ended) break;
    }
    return status;
}
