/* SPDX-License-Identifier: MIT */
/* boundary.c - supports and loads, as the caller adds and removes them. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* ---- loads and supports ------------------------------------------------------------------------------------------- */

/* A dof belongs to the last support that prescribes it: gives support s its dofs, and takes them from those before it. */
static void peri__assign_support(peri_body *b, int64_t s) {
    peri__load *load = &b->loads[s];
    if (load->owned) memset(load->owned, load->axes, (size_t)load->count);
    for (int64_t e = 0; load->owned && e < s; ++e) {
        peri__load *earlier = &b->loads[e];
        int64_t a = 0, c = 0;
        if (!earlier->owned) continue;
        while (a < earlier->count && c < load->count) { /* both ascending */
            int32_t p = peri__set_point(b, earlier->set, a), q = peri__set_point(b, load->set, c);
            if (p == q) earlier->owned[a] = (uint8_t)(earlier->owned[a] & ~load->axes);
            if (p <= q) a++;
            if (q <= p) c++;
        }
    }
}

/* Returns where in b->loads it is. `set` as inside; axes: bits. */
static int32_t peri__add_load(peri_body *b, int32_t kind, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                              void *user) {
    peri__load load;
    int support = kind != PERI__FORCE;
    PERI_NEED(b, value || fn || support, "value");
    int32_t status = peri__check_room(b, PERI_KIND_LOAD, PERI_ID_LIMIT, "load");
    if (status < 0) return status;
    memset(&load, 0, sizeof load);
    for (int32_t d = 0; value && d < b->dim; ++d) { /* what is not prescribed may be anything */
        if (peri__finite(value[d])) load.constant[d] = value[d];
        else if (axes >> d & 1) return peri__fail(b, PERI_ERROR_RANGE, "value", -1, value[d]);
    }
    load.kind = kind;
    load.set = set;
    load.axes = axes;
    load.fn = fn;
    load.user = user;
    load.per_value = 1.0;
    load.count = peri__set_count(b, set);
    if (!peri__grow(&b->memory, &b->loads, &b->load_capacity, b->load_count + 1, sizeof *b->loads))
        return peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
    if (fn) load.value = (double *)peri__new(&b->memory, load.count * b->dim, sizeof(double));
    if (fn && set == 0) load.all = (int32_t *)peri__new(&b->memory, load.count, sizeof *load.all);
    if (support) load.force = (double *)peri__new(&b->memory, PERI__SUPPORT_PLANES * load.count * b->dim, sizeof(double));
    if (support) load.owned = (uint8_t *)peri__new(&b->memory, load.count, 1);
    if ((fn && !load.value) || (fn && set == 0 && !load.all) || (support && (!load.force || !load.owned))) {
        peri__free_load(b, &load);
        return peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
    }
    for (int64_t k = 0; load.all && k < load.count; ++k) load.all[k] = peri__set_point(b, set, k);
    b->loads[b->load_count++] = load;
    peri__changed(b, PERI__ACTION);
    peri__assign_support(b, b->load_count - 1);
    return (int32_t)(b->load_count - 1);
}

/* The id of a load, of where it is, or the error instead. */
static int32_t peri__load_id(const peri_body *b, int32_t at) { return at < 0 ? at : peri__id(b, PERI_KIND_LOAD, at); }

static int32_t peri__prescribe(peri_body *b, int32_t kind, int32_t id, int32_t axes, const double *value, peri_load_fn fn, void *user) {
    const int32_t all = b->dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY, none = PERI_AXIS_X & PERI_AXIS_Y;
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    if ((axes & none) != none || (axes & ~all) != 0 || axes == none) return peri__fail(b, PERI_ERROR_CHOICE, "axes", -1, axes);
    return peri__load_id(b, peri__add_load(b, kind, set, axes & ~none, value, fn, user));
}

PERI_API int32_t peri_prescribe_displacement(peri_body *b, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                                             void *user) {
    PERI_NEED_CHANGEABLE(b);
    return peri__prescribe(b, PERI__DISPLACEMENT, set, axes, value, fn, user);
}

PERI_API int32_t peri_prescribe_velocity(peri_body *b, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                                         void *user) {
    PERI_NEED_CHANGEABLE(b);
    return peri__prescribe(b, PERI__VELOCITY, set, axes, value, fn, user);
}

/* Takes the last load back. */
static void peri__drop_load(peri_body *b) {
    peri__free_load(b, &b->loads[--b->load_count]);
    for (int64_t s = 0; s < b->load_count; ++s) peri__assign_support(b, s);
}

PERI_API int32_t peri_prescribe_rigid(peri_body *b, int32_t id, const double *centre, const double *motion, peri_rigid_fn fn, void *user) {
    PERI_NEED_CHANGEABLE(b);
    const int32_t dim = b->dim, turns = dim == 3 ? 3 : 1;
    PERI_NEED_VECTOR(b, centre);
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    if (motion && !peri__finite_vector(motion, dim + turns))
        return peri__fail(b, PERI_ERROR_RANGE, "motion", -1, peri__not_finite(motion, dim + turns));
    const int32_t at = peri__add_load(b, PERI__DISPLACEMENT, set, (1 << dim) - 1, motion, NULL, user);
    if (at < 0) return at;
    peri__load *load = &b->loads[at];
    load->value = (double *)peri__new(&b->memory, load->count * dim, sizeof *load->value);
    if (!load->value) {
        peri__drop_load(b);
        return peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
    }
    load->rigid = 1;
    load->motion = fn;
    for (int32_t d = 0; d < dim; ++d) load->centre[d] = centre[d];
    for (int32_t d = 0; motion && d < turns; ++d) load->turn[3 - turns + d] = motion[dim + d];
    return peri__load_id(b, at);
}

PERI_API int32_t peri_apply_body_force(peri_body *b, int32_t set, const double *value, peri_load_fn fn, void *user) {
    PERI_NEED_CHANGEABLE(b);
    const int32_t at = peri__find_set(b, set);
    return at < 0 ? at : peri__load_id(b, peri__add_load(b, PERI__FORCE, at, (1 << b->dim) - 1, value, fn, user));
}

/* The volume of a set of all parts, to 2^-52 of a unit per point, with the same bits for every partition: the sums of multiples of 2^-26,
   and of what is left of them, are exact. */
static int32_t peri__volume_of_parts(peri_body *b, int32_t set, double *volume) {
    double sum[2] = { 0.0, 0.0 };
    for (int64_t k = 0; k < peri__set_count(b, set); ++k) {
        const double own = b->model->volume[peri__set_point(b, set, k)], coarse = ldexp(floor(ldexp(own, 26)), -26);
        sum[0] += coarse;
        sum[1] += ldexp(floor(ldexp(own - coarse, 52)), -52);
    }
    const int32_t status = peri__share_total(b, PERI_OK, 2, sum);
    *volume = sum[0] + sum[1];
    return status;
}

PERI_API int32_t peri_apply_layer_traction(peri_body *b, int32_t id, double area, const double *value, peri_load_fn fn,
                                           void *user) {
    double volume = 0.0;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_NUMBER(b, area > 0.0, area);
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    const peri__model *m = b->model;
    for (int64_t k = 0; k < peri__set_count(b, set); ++k) volume += m->volume[peri__set_point(b, set, k)];
    const int32_t status = m->part ? peri__volume_of_parts(b, set, &volume) : PERI_OK;
    if (status < 0) return status;
    if (!(volume > 0.0)) return peri__fail(b, PERI_ERROR_RANGE, "set", id, 0.0);
    const int32_t at = peri__add_load(b, PERI__FORCE, set, (1 << b->dim) - 1, value, fn, user);
    if (at >= 0) b->loads[at].per_value = area / (volume * pow(m->length, b->dim));
    return peri__load_id(b, at);
}

PERI_API int32_t peri_remove_load(peri_body *b, int32_t id) {
    PERI_NEED_CHANGEABLE(b);
    const int64_t load = peri__find(b, PERI_KIND_LOAD, id, "load");
    if (load < 0) return (int32_t)load;
    const int support = b->loads[load].owned != NULL;
    peri__free_load(b, &b->loads[load]);
    b->loads[load].kind = PERI__FREE;
    peri__changed(b, PERI__ACTION);
    for (int64_t s = 0; support && s < b->load_count; ++s) peri__assign_support(b, s);
    return PERI_OK;
}
