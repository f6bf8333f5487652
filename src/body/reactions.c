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

PERI_API int32_t peri_get_obstacle_force(peri_body *b, int32_t id, double *force) {
    PERI_NEED_BUILT(b);
    const int64_t obstacle = peri__find(b, PERI_KIND_OBSTACLE, id, "obstacle");
    if (obstacle < 0) return (int32_t)obstacle;
    PERI_NEED(b, force, "force");
    const int32_t status = peri__ensure_force(b); /* moves the obstacle to where it is now */
    if (status < 0) return status;
    const peri__model *m = b->model;
    double total[3] = { 0.0, 0.0, 0.0 };
    for (int64_t i = 0; i < m->points; ++i) {
        double push[3] = { 0.0, 0.0, 0.0 };
        peri__push(b, &b->obstacles[obstacle], i, push);
        for (int32_t d = 0; d < m->dim; ++d) total[d] += push[d] * m->volume[i];
    }
    return peri__tell_force(b, total, force);
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

/* Of the load at an index. */
static int32_t peri__read_reaction_of(peri_body *b, int64_t at, double *force) {
    const int32_t status = peri__ensure_force(b);
    if (status < 0) return status;
    const peri__model *m = b->model;
    const peri__load *load = &b->loads[at];
    double total[3] = { 0.0, 0.0, 0.0 };
    for (int64_t k = 0; k < load->count; ++k)
        for (int32_t d = 0; d < m->dim; ++d) {
            double volume = m->volume[peri__set_point(b, load->set, k)];
            if (load->owned && !(load->owned[k] >> d & 1)) continue;
            if (load->owned) total[d] += *peri__support_at(b, load, PERI__SUPPORT_REACTION, k, d) * volume;
            else total[d] += peri__load_force(b, load, k, d) * volume;
        }
    return peri__tell_force(b, total, force);
}

PERI_API int32_t peri_get_reaction(peri_body *b, int32_t load, double *force) {
    PERI_NEED_BUILT(b);
    const int64_t at = peri__find(b, PERI_KIND_LOAD, load, "load");
    if (at < 0) return (int32_t)at;
    PERI_NEED(b, force, "force");
    return peri__read_reaction_of(b, at, force);
}
