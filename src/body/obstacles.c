/* SPDX-License-Identifier: MIT */
/* obstacles.c - what obstacles do to the force, and their work: by the rule of loads.c. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Moves the obstacles to where they are at `time`. */
static int32_t peri__move_obstacles(peri_body *b, double time) {
    for (int64_t k = 0; k < b->obstacle_count; ++k) {
        peri__obstacle *o = &b->obstacles[k];
        double place[3] = { 0.0, 0.0, 0.0 };
        if (o->kind == PERI__REMOVED || !o->motion) continue;
        for (int32_t d = 0; d < b->dim; ++d) place[d] = b->model->origin[d] + o->position0[d] * b->model->length;
        const int32_t said = o->motion(o->user, time, place);
        if (said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, "peri_motion_fn", -1, said);
        if (said > 0) b->stop = 1;
        if (!peri__finite_vector(place, b->dim)) return peri__fail(b, PERI_ERROR_CALLBACK, "place", -1, peri__not_finite(place, b->dim));
        peri__inner(b, place, o->position);
    }
    return PERI_OK;
}

/* Adds the force density of one obstacle on point i to push[dim]. */
static void peri__push(const peri_body *b, const peri__obstacle *o, int64_t i, double *push) {
    const peri__model *m = b->model;
    double r[3], depth, square = 0.0;
    if (o->kind == PERI__REMOVED) return;
    for (int32_t d = 0; d < m->dim; ++d) {
        int64_t at = d * m->stride + i;
        r[d] = peri__get_real(m->x, b->f32, at) + peri__get_real(b->u, b->f32, at) - o->position[d];
        square += r[d] * r[d];
    }
    if (o->kind == PERI__BALL) {
        double distance = sqrt(square);
        depth = o->radius - distance;
        for (int32_t d = 0; depth > 0.0 && d < m->dim; ++d) push[d] += o->stiffness * depth * r[d] / (distance + 1e-290);
    } else {
        depth = -peri__dot(o->normal, r, m->dim);
        for (int32_t d = 0; depth > 0.0 && d < m->dim; ++d) push[d] += o->stiffness * depth * o->normal[d];
    }
}

typedef struct peri__pusher {
    peri_body *body;
    double     half_step; /* dt/2                                                                                         */
} peri__pusher;

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
    const peri__pusher *pusher = (const peri__pusher *)context;
    peri_body *b = pusher->body;
    const peri__model *m = b->model;
    for (int64_t i = begin; i < end; ++i) {
        double push[3] = { 0.0, 0.0, 0.0 }, work = 0.0;
        for (int64_t k = 0; k < b->obstacle_count; ++k) peri__push(b, &b->obstacles[k], i, push);
        for (int32_t d = 0; d < m->dim; ++d) {
            int64_t at = d * m->stride + i;
            work += (b->push[at] + push[d]) * peri__get_real(b->v, b->f32, at);
            b->push[at] = push[d];
            if (push[d] == 0.0) continue;
            const double force = peri__get_real(b->f, b->f32, at) + push[d];
            if (sums->bad < 0 && peri__is_pushed_out(b, i, force)) sums->bad = i;
            peri__put_real(b->f, b->f32, at, force);
        }
        sums->a += pusher->half_step * work * m->volume[i];
    }
}

/* Adds all obstacles at `time` to f; dt > 0: counts the work of the step that ends there. */
static int32_t peri__apply_obstacles(peri_body *b, double time, double dt) {
    peri__pusher pusher = { b, 0.5 * dt };
    if (b->obstacle_count == 0) return PERI_OK;
    int32_t status = peri__move_obstacles(b, time);
    if (status < 0) return status;
    peri__for_points(b, b->model->points, 4 * b->obstacle_count, peri__push_block, &pusher, b->sums);
    const peri__sums total = peri__total(b->sums, b->model->points);
    for (int32_t d = 0; total.bad >= 0 && d < b->dim; ++d) {
        const double force = peri__get_real(b->f, b->f32, d * b->model->stride + total.bad);
        if (!peri__is_pushed_out(b, total.bad, force)) continue;
        return peri__fail(b, PERI_ERROR_RANGE, "stiffness", total.bad, force * peri__force_unit(b->model));
    }
    if (b->desc.ledger && dt > 0.0) b->now.ledger.obstacle += total.a;
    return PERI_OK;
}
