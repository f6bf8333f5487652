/* SPDX-License-Identifier: MIT */
/* reactions.c - the forces of obstacles, supports and loads, read. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* A total in inner units to force[dim]. Many forces, each within double, may sum up beyond it. */
static int32_t peri__tell_force(peri_body *b, const double *total, double *force) {
    const peri__model *m = b->model;
    double told[3] = { 0.0, 0.0, 0.0 };
    for (int32_t d = 0; d < m->dim; ++d) told[d] = total[d] * m->energy / m->length;
    if (!peri__finite_vector(told, m->dim)) return peri__fail(b, PERI_ERROR_RANGE, "force", -1, peri__not_finite(told, m->dim));
    memcpy(force, told, (size_t)m->dim * sizeof *force);
    return PERI_OK;
}

/* A total moment in inner units to moment[1] in 2D, [3]. */
static int32_t peri__tell_moment(peri_body *b, const double *total, double *moment) {
    double told[3];
    for (int d = 0; d < 3; ++d) told[d] = total[d] * b->model->energy;
    if (!peri__finite_vector(told, 3)) return peri__fail(b, PERI_ERROR_RANGE, "moment", -1, peri__not_finite(told, 3));
    memcpy(moment, b->dim == 3 ? told : &told[2], (size_t)(b->dim == 3 ? 3 : 1) * sizeof *moment);
    return PERI_OK;
}

/* Force and moment about the origin of the frame, to total[6]: noted where tallied; of smooth ones by the places of the points. */
static int32_t peri__sum_obstacle(peri_body *b, const peri__obstacle *o, double *total) {
    peri__pusher pusher = { b, 0.0, 0.0, PERI_OK };
    double tally[PERI_TALLIED] = { 0.0 };
    for (int d = 0; d < 3; ++d) {
        total[d] = o->force[d];
        total[3 + d] = o->moment[d];
    }
    if (o->tally) return PERI_OK;
    for (int64_t i = 0; i < b->model->points; ++i) {
        double push[3] = { 0.0, 0.0, 0.0 };
        if (peri__is_ghost(b->model, i)) continue;
        const int32_t status = peri__push(&pusher, o, i, push, tally);
        if (status < 0) return status;
    }
    memcpy(total, tally, 6 * sizeof *total);
    return PERI_OK;
}

PERI_API int32_t peri_get_obstacle_force(peri_body *b, int32_t id, double *force, double *moment) {
    double total[6], turns[3]; /* either is told only where both can be */
    PERI_NEED_BUILT(b);
    const int64_t obstacle = peri__find(b, PERI_KIND_OBSTACLE, id, "obstacle");
    if (obstacle < 0) return (int32_t)obstacle;
    PERI_NEED(b, force || moment, "force");
    int32_t status = peri__ensure_force(b); /* moves the obstacle to where it is now */
    if (status == PERI_OK) status = peri__sum_obstacle(b, &b->obstacles[obstacle], total);
    status = peri__share_total(b, status, 6, total);
    if (status < 0) return status;
    if (moment) status = peri__tell_moment(b, total + 3, turns);
    if (status == PERI_OK && force) status = peri__tell_force(b, total, force);
    if (status == PERI_OK && moment) memcpy(moment, turns, (size_t)(b->dim == 3 ? 3 : 1) * sizeof *moment);
    return status;
}

/* Force density of the supports on every point, inner units. */
static void peri__read_reactions(const peri_body *b, double *out) {
    const peri__model *m = b->model;
    for (int64_t k = 0; k < m->points * m->dim; ++k) out[k] = 0.0;
    for (int64_t s = 0; s < b->load_count; ++s) {
        const peri__load *load = &b->loads[s];
        for (int64_t k = 0; load->owned && k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d)
                if (load->owned[k] >> d & 1)
                    out[peri__set_point(b, load->set, k) * m->dim + d] = *peri__support_at(b, load, PERI__SUPPORT_REACTION, k, d);
    }
}

/* Component d of the force on point k of a load or support, inner units. */
static double peri__reaction_at(const peri_body *b, const peri__load *load, int64_t k, int32_t d) {
    const double volume = b->model->volume[peri__set_point(b, load->set, k)];
    if (!load->owned) return peri__load_force(b, load, k, d) * volume;
    return load->owned[k] >> d & 1 ? *peri__support_at(b, load, PERI__SUPPORT_REACTION, k, d) * volume : 0.0;
}

/* Of the load at an index. */
static int32_t peri__read_reaction_of(peri_body *b, int64_t at, double *force) {
    int32_t status = peri__ensure_force(b);
    const peri__load *load = &b->loads[at];
    double total[3] = { 0.0, 0.0, 0.0 };
    for (int64_t k = 0; status == PERI_OK && k < load->count; ++k)
        for (int32_t d = 0; d < b->dim; ++d) total[d] += peri__reaction_at(b, load, k, d);
    status = peri__share_total(b, status, 3, total);
    return status < 0 ? status : peri__tell_force(b, total, force);
}

PERI_API int32_t peri_get_reaction(peri_body *b, int32_t load, double *force) {
    PERI_NEED_BUILT(b);
    const int64_t at = peri__find(b, PERI_KIND_LOAD, load, "load");
    if (at < 0) return (int32_t)at;
    PERI_NEED(b, force, "force");
    return peri__read_reaction_of(b, at, force);
}

PERI_API int32_t peri_get_reaction_moment(peri_body *b, int32_t id, const double *place, double *moment) {
    PERI_NEED_BUILT(b);
    const int64_t at = peri__find(b, PERI_KIND_LOAD, id, "load");
    if (at < 0) return (int32_t)at;
    PERI_NEED_VECTOR(b, place);
    PERI_NEED(b, moment, "moment");
    const int32_t dim = b->dim, linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    int32_t status = peri__ensure_force(b);
    const peri__load *load = &b->loads[at];
    double about[3] = { 0.0, 0.0, 0.0 }, total[3] = { 0.0, 0.0, 0.0 };
    peri__inner(b, place, about);
    for (int64_t k = 0; status == PERI_OK && k < load->count; ++k) {
        double arm[3] = { 0.0, 0.0, 0.0 }, force[3] = { 0.0, 0.0, 0.0 }, part[3];
        for (int32_t d = 0; d < dim; ++d) {
            const int64_t dof = peri__dof(b, load, k, d);
            arm[d] = peri__get_real(b->model->x, b->f32, dof) + (linear ? 0.0 : peri__get_real(b->u, b->f32, dof)) - about[d];
            force[d] = peri__reaction_at(b, load, k, d);
        }
        peri__cross(arm, force, part);
        for (int d = 0; d < 3; ++d) total[d] += part[d];
    }
    status = peri__share_total(b, status, 3, total);
    return status < 0 ? status : peri__tell_moment(b, total, moment);
}
