/* SPDX-License-Identifier: MIT */
/* obstacles.c - what obstacles do to the force, and their work: by the rule of loads.c.

   A point at a depth > 0 is pushed along the outward normal n by N = k depth, and where the obstacle is lossy by more, per volume:

     hysteresis   N = k depth (1 + w a/a0), never below 0, a the speed of approach and a0 the largest since it touched. The energy that a
                  mass on such a spring gets back does not depend on the mass, k or a0: Hunt and Crossley 1975. w follows from the
                  restitution e by w - ln(1 + w) = -e w - ln(1 - e w)
     friction     -mu N along the slip, less in proportion where slip is slower than friction_speed

   Both resist a velocity by a coefficient. It is held below peri__damping_limit times the density, which the stable step knows: a light
   point that a heavy body presses would else be thrown back. The velocities are those of the step (loads.c): the points have it in v, a
   moving obstacle by the difference of its places. peri_solve knows no velocities: there obstacles are smooth. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* The coefficient of velocity, over the density, that all lossy obstacles together may have on a point. */
static double peri__damping_limit(const peri_body *b) {
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind && b->obstacles[k].lossy) return 0.3 * sqrt(b->model->row_sum);
    return 0.0;
}

/* ---- motion ------------------------------------------------------------------------------------------------------- */

/* Asks where an obstacle is at `time`. */
static int32_t peri__ask_motion(peri_body *b, peri__obstacle *o, double time) {
    double place[3] = { 0.0 }, turn[4];
    memcpy(turn, o->turn0, sizeof turn);
    for (int32_t d = 0; d < b->dim; ++d) place[d] = b->model->origin[d] + o->position0[d] * b->model->length;
    const int32_t said = o->motion(o->user, time, place, turn);
    if (said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, "peri_motion_fn", -1, said);
    if (said > 0) b->stop = 1;
    if (!peri__finite_vector(place, b->dim)) return peri__fail(b, PERI_ERROR_CALLBACK, "place", -1, peri__not_finite(place, b->dim));
    if (!peri__read_turn(b->dim, turn, o->turn)) return peri__fail(b, PERI_ERROR_CALLBACK, "turn", -1, peri__not_finite(turn, 4));
    peri__inner(b, place, o->position);
    peri__update_axes(o, b->dim);
    return PERI_OK;
}

/* Moves the obstacles to where they are at `time`; dt > 0: at the end of a step. */
static int32_t peri__move_obstacles(peri_body *b, double time, double dt) {
    for (int64_t k = 0; k < b->obstacle_count; ++k) {
        peri__obstacle *o = &b->obstacles[k];
        double from[3], before[4];
        if (o->kind == PERI__REMOVED) continue;
        if (o->free && dt > 0.0) {
            peri__kick_free(o->free, 0.5 * dt);
            peri__drift_free(o, b->dim, dt);
            if (!peri__is_bounded(o)) return peri__fail(b, PERI_ERROR_UNSTABLE, "obstacle", peri__id(b, PERI_KIND_OBSTACLE, k), time);
        }
        if (!o->motion) continue;
        memcpy(from, o->position, sizeof from);
        memcpy(before, o->turn, sizeof before);
        const int32_t status = peri__ask_motion(b, o, time);
        if (status < 0) return status;
        if (!(dt > 0.0)) continue;
        for (int d = 0; d < 3; ++d) o->velocity[d] = (o->position[d] - from[d]) / dt;
        peri__spin_between(b->dim, before, o->turn, dt, o->spin);
    }
    return PERI_OK;
}

/* ---- touch -------------------------------------------------------------------------------------------------------- */

typedef struct peri__dip { /* of a point by an obstacle                                                                 */
    double r[3];      /* from the origin of its frame                                                                     */
    double depth;     /* > 0: within                                                                                      */
    double normal[3]; /* there                                                                                            */
} peri__dip;

/* What counts as near a free one: where it may come in two steps, and a quarter of a spacing. */
static double peri__foresight(const peri_body *b, const peri__obstacle *o) {
    if (!o->free) return 0.0;
    return 0.25 * b->model->spacing + 5.0 * sqrt(peri__dot(o->velocity, o->velocity, 3) / b->model->row_sum);
}

/* Asks for the signed distance at y of the own frame; the point is that of an error. */
static int32_t peri__ask_distance(peri_body *b, const peri__obstacle *o, int64_t point, const double *y, double reach, peri__dip *t) {
    double x[3], distance = 1.0, normal[3] = { 0.0 };
    for (int d = 0; d < 3; ++d) x[d] = y[d] * b->model->length;
    const int32_t former = peri__enter(b, b->running == PERI__IN_LOG ? PERI__IN_LOG : PERI__IN_CALLBACK);
    const int32_t said = o->solid.distance(o->user, x, &distance, normal);
    peri__leave(b, former);
    if (said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, "peri_distance_fn", point, said);
    if (said > 0) b->stop = 1;
    if (!peri__finite(distance)) return peri__fail(b, PERI_ERROR_CALLBACK, "distance", point, distance);
    t->depth = -distance / b->model->length;
    if (t->depth > -reach && !(peri__finite_vector(normal, b->dim) && peri__direction(normal, b->dim, t->normal)))
        return peri__fail(b, PERI_ERROR_CALLBACK, "normal", point, peri__not_finite(normal, b->dim));
    return PERI_OK;
}

/* Is point i within the obstacle? 1, 0, or why a callback failed. Up to `reach` outside depth and normal are told as well. Calls none but
   those of signed distances, so that threads may share. */
static int32_t peri__dips(const peri_body *b, const peri__obstacle *o, int64_t i, double reach, peri__dip *t) {
    const peri__model *m = b->model;
    const int32_t dim = m->dim;
    double own[3];
    t->r[2] = t->depth = t->normal[0] = t->normal[1] = t->normal[2] = 0.0;
    if (o->kind == PERI__REMOVED) return 0;
    for (int32_t d = 0; d < dim; ++d) {
        const int64_t at = d * m->stride + i;
        t->r[d] = peri__get_real(m->x, b->f32, at) + peri__get_real(b->u, b->f32, at) - o->position[d];
    }
    if (o->kind == PERI_SHAPE_PLANE) {
        t->depth = -peri__dot(o->normal, t->r, dim);
        if (t->depth > -reach || t->depth > 0.0) memcpy(t->normal, o->normal, sizeof t->normal);
        return t->depth > 0.0;
    }
    t->depth = -HUGE_VAL;
    const double within = o->kind == PERI_SHAPE_DISTANCE && o->solid.radius > 0.0 ? o->solid.radius + reach : HUGE_VAL;
    if (peri__dot(t->r, t->r, dim) > within * within) return 0;
    memcpy(own, t->r, sizeof own);
    if (o->turned) peri__to_own(o->axes, t->r, own);
    if (o->kind == PERI_SHAPE_DISTANCE) {
        const int32_t status = peri__ask_distance((peri_body *)b, o, i, own, reach, t);
        if (status < 0) return status;
    } else
        t->depth = peri__solid_depth(&o->solid, dim, own, reach, t->normal);
    if (!(t->depth > -reach)) return 0;
    if (o->turned) {
        memcpy(own, t->normal, sizeof own);
        peri__to_body(o->axes, own, t->normal);
    }
    return t->depth > 0.0;
}

/* ---- force -------------------------------------------------------------------------------------------------------- */

typedef struct peri__pusher {
    peri_body *body;
    double     step;  /* dt; 0: no step ends here                                                                         */
    double     limit; /* of coefficients of velocity, over the density, per lossy obstacle                                */
    int32_t    status; /* of a callback that failed                                                                       */
} peri__pusher;

/* The velocity of point i over the surface of the obstacle, which turned as it came here: at the middle of its way. */
static void peri__slip(const peri__pusher *p, const peri__obstacle *o, int64_t i, const double *r, double *slip) {
    const peri_body *b = p->body;
    double turned[3], middle[3], carried[3];
    peri__cross(o->spin, r, turned);
    for (int d = 0; d < 3; ++d) middle[d] = r[d] - 0.5 * p->step * turned[d];
    peri__cross(o->spin, middle, carried);
    slip[2] = 0.0;
    for (int32_t d = 0; d < b->dim; ++d) slip[d] = peri__get_real(b->v, b->f32, d * b->model->stride + i) - o->velocity[d] - carried[d];
}

/* Adds to push what a lossy obstacle takes energy by at a point; returns the energy that it took in this step, per volume, by the
   trapezoidal rule as all work. elastic: k depth; 0 where the point has left. */
static double peri__rub(const peri__pusher *p, const peri__obstacle *o, int64_t i, const peri__dip *t, double elastic, double *push) {
    const double most = p->limit * peri__density_at(p->body, i);
    double *fastest = &o->kept[i * PERI_KEPT], *force = fastest + 1, slip[3], pressed = elastic, lost = 0.0;
    if (!(elastic > 0.0) && *fastest == 0.0 && force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0) return 0.0;
    peri__slip(p, o, i, t->r, slip);
    const double along = peri__dot(slip, t->normal, 3);
    if (p->step > 0.0) *fastest = elastic > 0.0 ? fmax(*fastest, -along) : 0.0;
    if (*fastest > 0.0) pressed = fmax(0.0, elastic - fmin(elastic * o->hysteresis / *fastest, most) * along);
    double speed = sqrt(fmax(0.0, peri__dot(slip, slip, 3) - along * along));
    const double drag = fmin(o->friction * pressed / fmax(speed, o->friction_speed), most);
    for (int d = 0; d < 3; ++d) {
        const double now = (pressed - elastic) * t->normal[d] - drag * (slip[d] - along * t->normal[d]);
        lost -= 0.5 * p->step * (force[d] + now) * slip[d];
        force[d] = now;
        push[d] += now;
    }
    return lost;
}

/* Adds point i to what is near a free obstacle. */
static void peri__note_near(const peri_body *b, const peri__obstacle *o, int64_t i, const peri__dip *t, double *touched, double *swept) {
    const double volume = b->model->volume[i];
    double moment[3], arm[3];
    if (!(t->depth > -peri__foresight(b, o))) return;
    peri__to_centre(o, arm);
    for (int d = 0; d < 3; ++d) arm[d] = t->r[d] - arm[d];
    peri__cross(arm, t->normal, moment);
    *touched += volume;
    *swept += volume * peri__dot(moment, moment, 3);
}

/* What the obstacle does to point i, added to push[3] and to its tally. */
static int32_t peri__push(const peri__pusher *p, const peri__obstacle *o, int64_t i, double *push, double *tally) {
    const peri_body *b = p->body;
    peri__dip t;
    double own[3] = { 0.0 }, moment[3];
    const int32_t touches = peri__dips(b, o, i, peri__foresight(b, o), &t);
    if (touches < 0 || (touches == 0 && !o->tally)) return touches;
    for (int d = 0; touches && d < 3; ++d) own[d] = o->stiffness * t.depth * t.normal[d];
    if (o->lossy && !b->now.still) {
        const double lost = peri__rub(p, o, i, &t, touches ? o->stiffness * t.depth : 0.0, own);
        if (tally) tally[6] += b->model->volume[i] * lost;
    }
    for (int d = 0; touches && d < 3; ++d) push[d] += own[d];
    if (!tally) return touches;
    const double volume = b->model->volume[i];
    peri__cross(t.r, own, moment);
    for (int d = 0; touches && d < 3; ++d) {
        tally[d] += volume * own[d];
        tally[3 + d] += volume * moment[d];
    }
    if (o->free) peri__note_near(b, o, i, &t, &tally[7], &tally[8]);
    return touches;
}

/* Is the force density f on point i beyond the precision, of a point that is not? Where the motion itself has left the numbers that is for
   its own status. */
static int peri__is_pushed_out(const peri_body *b, int64_t i, double f) {
    if (fabs(f) < peri__most_force(b)) return 0;
    for (int32_t d = 0; d < b->dim; ++d)
        if (!peri__finite(peri__get_real(b->u, b->f32, d * b->model->stride + i))) return 0;
    return 1;
}

/* sums->a: work of old and new push; bad: the first point whose force is beyond the precision. */
static void peri__push_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri__pusher *p = (peri__pusher *)context;
    peri_body *b = p->body;
    const peri__model *m = b->model;
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].tally) memset(&b->obstacles[k].tally[begin / PERI_BLOCK * PERI_TALLIED], 0, PERI_TALLIED * sizeof(double));
    for (int64_t i = begin; i < end; ++i) {
        if (peri__is_ghost(m, i)) continue;
        double push[3] = { 0.0, 0.0, 0.0 }, work = 0.0;
        for (int64_t k = 0; k < b->obstacle_count; ++k) {
            const peri__obstacle *o = &b->obstacles[k];
            const int32_t status = peri__push(p, o, i, push, o->tally ? &o->tally[begin / PERI_BLOCK * PERI_TALLIED] : NULL);
            if (status < 0 && p->status == PERI_OK) p->status = status; /* of a callback: then there is one thread */
        }
        for (int32_t d = 0; d < m->dim; ++d) {
            int64_t at = d * m->stride + i;
            work += (b->push[at] + push[d]) * peri__get_real(b->v, b->f32, at);
            b->push[at] = push[d];
            if (push[d] == 0.0) continue;
            const double force = peri__get_real(b->f, b->f32, at) + push[d];
            if (sums->bad < 0 && peri__is_pushed_out(b, i, force)) sums->bad = i;
            peri__put_real(b->f, b->f32, at, force);
        }
        sums->a += 0.5 * p->step * work * m->volume[i];
    }
}

/* Runs the blocks: on this thread, in order, where that has callbacks to make. */
static void peri__push_points(peri__pusher *p) {
    peri_body *b = p->body;
    const peri__model *m = b->model;
    int64_t lossy = 0, asks = 0;
    for (int64_t k = 0; k < b->obstacle_count; ++k) {
        lossy += b->obstacles[k].kind && b->obstacles[k].lossy;
        asks += b->obstacles[k].kind == PERI_SHAPE_DISTANCE;
    }
    p->limit = lossy > 0 ? peri__damping_limit(b) / (double)lossy : 0.0;
    if (asks == 0) {
        peri__for_points(b, m->points, 4 * b->obstacle_count, peri__push_block, p, b->sums);
        return;
    }
    for (int64_t k = 0; k < m->blocks && p->status == PERI_OK; ++k) {
        const peri__sums none = { 0.0, 0.0, 0, -1 };
        b->sums[k] = none;
        peri__push_block(p, k * PERI_BLOCK, peri__min((k + 1) * PERI_BLOCK, m->points), &b->sums[k]);
    }
}

/* Sums up what the blocks have tallied, and ends the step of a free body. */
static void peri__close_obstacle(peri_body *b, peri__obstacle *o, double dt) {
    double total[PERI_TALLIED] = { 0.0 }, way[3], turned[3];
    for (int64_t k = 0; k < b->model->blocks; ++k)
        for (int n = 0; n < PERI_TALLIED; ++n) total[n] += o->tally[k * PERI_TALLIED + n];
    memcpy(o->force, total, sizeof o->force);
    memcpy(o->moment, total + 3, sizeof o->moment);
    if (b->desc.ledger) o->lost += total[6];
    if (!o->free) return;
    peri__to_centre(o, way);
    peri__cross(way, total, turned);
    for (int d = 0; d < 3; ++d) {
        o->free->force[d] = -total[d];
        o->free->moment[d] = turned[d] - total[3 + d];
    }
    o->free->touched = total[7];
    o->free->swept = total[8];
    if (!(dt > 0.0)) return;
    peri__kick_free(o->free, 0.5 * dt);
    peri__update_velocity(o);
}

/* What free obstacles are near, where the force does not tell: by block, as the force does. Where a signed distance fails it stays as it
   was, and whoever makes the force tells why. */
static void peri__look_at_free(peri_body *b) {
    const int64_t points = b->model->points;
    const int32_t stop = b->stop;
    const peri_error record = b->error;
    for (int64_t k = 0; k < b->obstacle_count && b->now.stale & PERI__STALE_FORCE; ++k) {
        const peri__obstacle *o = &b->obstacles[k];
        double touched = 0.0, swept = 0.0;
        int32_t status = PERI_OK;
        if (!o->kind || !o->free) continue;
        for (int64_t begin = 0; begin < points && status >= 0; begin += PERI_BLOCK) {
            double near_by = 0.0, turned = 0.0;
            for (int64_t i = begin; i < points && i < begin + PERI_BLOCK && status >= 0; ++i) {
                peri__dip t;
                status = peri__dips(b, o, i, peri__foresight(b, o), &t);
                if (status >= 0) peri__note_near(b, o, i, &t, &near_by, &turned);
            }
            touched += near_by;
            swept += turned;
        }
        if (status < 0) continue;
        o->free->touched = touched;
        o->free->swept = swept;
    }
    b->stop = stop;
    b->error = record;
}

/* Adds all obstacles at `time` to f; dt > 0: counts the work of the step that ends there. */
static int32_t peri__apply_obstacles(peri_body *b, double time, double dt) {
    peri__pusher pusher = { b, dt, 0.0, PERI_OK };
    if (b->obstacle_count == 0) return PERI_OK;
    int32_t status = peri__move_obstacles(b, time, dt);
    if (status < 0) return status;
    peri__push_points(&pusher);
    if (pusher.status < 0) return pusher.status;
    const peri__sums total = peri__total(b->sums, b->model->points);
    for (int32_t d = 0; total.bad >= 0 && d < b->dim; ++d) {
        const double force = peri__get_real(b->f, b->f32, d * b->model->stride + total.bad);
        if (!peri__is_pushed_out(b, total.bad, force)) continue;
        return peri__fail(b, PERI_ERROR_RANGE, "stiffness", total.bad, force * peri__force_unit(b->model));
    }
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind && b->obstacles[k].tally) peri__close_obstacle(b, &b->obstacles[k], dt);
    if (b->desc.ledger && dt > 0.0) b->now.ledger.obstacle += total.a;
    return PERI_OK;
}
