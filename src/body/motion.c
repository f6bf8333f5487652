/* SPDX-License-Identifier: MIT */
/* motion.c - displacement and velocity from outside, and back to the start. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Displacements and velocities that the arithmetic can square, and cube where stresses are P = F S: within 1e15 spacings, or 1e11; below
   1e9 speeds of sound. */
static double peri__state_limit(const peri_body *b, const void *array) {
    const int cubes = b->model->gathers & PERI__GRADIENT && b->b32 && b->desc.geometry != PERI_GEOMETRY_LINEAR;
    return array == b->v ? 1e9 : cubes ? 1e11 : 1e15;
}

/* Is a below the limit, inner units, as the array will hold it, too? Single precision may round it up to the limit. */
static int peri__holds_below(const peri_body *b, double a, double limit) {
    const double stored = peri__stored(a);
    return fabs(stored) < limit && (!b->f32 || fabs((double)(float)stored) < limit);
}

/* ghost: points whose entries count for nothing, or NULL. */
static int32_t peri__check_state(peri_body *b, const void *array, const double *in, int64_t count, double unit, const char *field,
                                 const uint8_t *ghost) {
    const double limit = peri__state_limit(b, array);
    for (int64_t k = 0; k < count; ++k)
        if (!(ghost && ghost[k / b->dim]) && !peri__holds_below(b, in[k] / unit, limit))
            return peri__fail(b, PERI_ERROR_RANGE, field, k / b->dim, in[k]);
    return PERI_OK;
}

/* Component d of a point's entry of the array with `value` added, inner units. */
static double peri__sum_at(const peri_body *b, const void *array, double unit, int64_t point, int32_t d, const double *value) {
    return peri__get_real(array, b->f32, d * b->model->stride + point) + value[d] / unit;
}

/* What counts is the sum: what peri_set_field refuses is not reached by adding twice either. */
static int32_t peri__check_sums(peri_body *b, const void *array, double unit, int32_t set, const double *value) {
    const double limit = peri__state_limit(b, array);
    for (int64_t k = 0; k < peri__set_count(b, set); ++k)
        for (int32_t d = 0; d < b->dim; ++d) {
            const double sum = peri__sum_at(b, array, unit, peri__set_point(b, set, k), d, value);
            if (!peri__holds_below(b, sum, limit))
                return peri__fail(b, PERI_ERROR_RANGE, "value", peri__set_point(b, set, k), sum * unit);
        }
    return PERI_OK;
}

static int32_t peri__add_to(peri_body *b, void *array, double unit, int32_t id, const double *value) {
    PERI_NEED_VECTOR(b, value);
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    int32_t status = peri__check_sums(b, array, unit, set, value);
    if (status == PERI_OK) status = peri__alter(b, PERI__MOTION);
    if (status < 0) return status;
    for (int64_t k = 0; k < peri__set_count(b, set); ++k)
        for (int32_t d = 0; d < b->dim; ++d) {
            const int64_t point = peri__set_point(b, set, k);
            peri__put_real(array, b->f32, d * b->model->stride + point, peri__sum_at(b, array, unit, point, d, value));
        }
    return PERI_OK;
}

PERI_API int32_t peri_add_displacement(peri_body *b, int32_t set, const double *value) {
    PERI_NEED_IDLE(b);
    return peri__add_to(b, b->u, b->model->length, set, value);
}

PERI_API int32_t peri_add_velocity(peri_body *b, int32_t set, const double *value) {
    PERI_NEED_IDLE(b);
    return peri__add_to(b, b->v, peri__velocity_unit(b->model), set, value);
}

PERI_API int32_t peri_set_mean_gradient(peri_body *b, const double *gradient) {
    PERI_NEED_IDLE(b);
    PERI_NEED(b, gradient, "gradient");
    for (int32_t k = 0; k < b->dim * b->dim; ++k)
        if (!(fabs(gradient[k]) < 1e3)) return peri__fail(b, PERI_ERROR_RANGE, "gradient", k, gradient[k]);
    if (!b->model->part) return peri__fail(b, PERI_ERROR_PART, "peri_set_part", -1, 0.0);
    const int32_t status = peri__alter(b, PERI__MOTION);
    if (status < 0) return status;
    memcpy(b->mean_gradient, gradient, (size_t)(b->dim * b->dim) * sizeof *gradient);
    return PERI_OK;
}

PERI_API int32_t peri_reset(peri_body *b) {
    PERI_NEED_IDLE(b);
    const peri__model *m = b->model;
    size_t vector = (size_t)(m->stride * m->dim) * peri__real(b);
    memset(b->u, 0, vector);
    memset(b->v, 0, vector);
    memset(b->f, 0, vector);
    peri__clear_arrays(b, 1);
    if (b->alive) {
        peri__set_flags(m, b->alive);
        if (b->uncut) memcpy(b->alive, b->uncut, (size_t)(m->points * m->words) * sizeof *b->alive);
    }
    peri__forget_breaks(b);
    peri__forget_contact(b->contact, m);
    peri__forget_seat(b->seat);
    for (int64_t k = 0; k < b->obstacle_count; ++k)
        if (b->obstacles[k].kind) peri__restart_obstacle(&b->obstacles[k], b->dim, m->points);
    for (int64_t k = 0; k < b->load_count; ++k) b->loads[k].stepped = 0;
    /* the estimate of the stable step is good again unless bonds were mended that count in it */
    const uint32_t sharp = b->now.broken > 0 && !b->softens ? PERI__STALE_SHARP : b->now.stale & PERI__STALE_SHARP;
    b->now = peri__at_start(b->now.cut);
    if (b->alive) peri__changed(b, PERI__BONDS);
    b->now.stale = (b->now.stale & ~(uint32_t)PERI__STALE_SHARP) | sharp;
    int strained = b->eigenstrain != NULL;
    for (int32_t k = 0; k < 9; ++k) strained |= b->mean_gradient[k] != 0.0; /* of a periodic cell */
    if (strained) { /* the energy that it begins with is initial */
        (void)peri__alter(b, PERI__EIGENSTRAIN);
        b->now.ledger.before = 0.0;
    }
    return PERI_OK;
}
