/* fields.c - fields by copy and by view, the ledger, the momenta. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

PERI_API int64_t peri_field_size(const peri_body *b, int32_t field) {
    if (!b) return PERI_ERROR_ARGUMENT;
    if (!b->model) return PERI_ERROR_ORDER;
    int32_t components = peri__components(field, b->dim);
    return components > 0 ? b->model->points * components : PERI_ERROR_FIELD;
}

/* Damage of point i ([L]): 1 - intact/all, both sums of beta V_j over the family; uncut_only: over bonds not cut at the start. */
static double peri__damage(const peri_body *b, int64_t i, int uncut_only) {
    const peri__model *m = b->model;
    double all = 0.0, intact = 0.0;
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        double part = row.part ? (double)row.part[k] : m->volume[row.ids[k]];
        if (uncut_only && b->uncut && !(b->uncut[i * m->words + k / 32] >> (k % 32) & 1)) continue;
        all += part;
        if (peri__is_alive(b, i, k)) intact += part;
    }
    return all > 0.0 ? 1.0 - intact / all : 0.0;
}

/* Fills a view of a stored field; 0 where the field is not stored. */
static int peri__stored_view(peri_body *b, int32_t field, peri_view *view) {
    const peri__model *m = b->model;
    view->count = m->points;
    view->point_stride = 1;
    view->component_stride = m->stride;
    view->components = b->dim;
    view->type = b->f32 ? PERI_F32 : PERI_F64;
    view->offset[0] = view->offset[1] = view->offset[2] = 0.0;
    switch (field) {
    case PERI_POSITION:
        view->data = m->x;
        view->scale = m->length;
        memcpy(view->offset, m->origin, sizeof view->offset);
        return 1;
    case PERI_DISPLACEMENT: view->data = b->u; view->scale = m->length; return 1;
    case PERI_VELOCITY: view->data = b->v; view->scale = peri__velocity_unit(m); return 1;
    case PERI_FORCE_DENSITY: view->data = b->f; view->scale = peri__force_unit(m); return 1;
    case PERI_VOLUME:
        view->data = m->volume;
        view->components = 1;
        view->type = PERI_F64;
        view->scale = pow(m->length, m->dim);
        return 1;
    default: return 0;
    }
}

static double peri__view_at(const peri_view *view, int64_t i, int32_t d) {
    int64_t at = i * view->point_stride + d * view->component_stride;
    return view->offset[d] + view->scale * peri__get_real(view->data, view->type == PERI_F32, at);
}

/* A field in the user's units and order; out is [peri_field_size]. */
static void peri__compute(peri_body *b, int32_t field, double *out) {
    const peri__model *m = b->model;
    peri_view view, moved;
    if (peri__stored_view(b, field, &view)) {
        for (int64_t i = 0; i < m->points; ++i)
            for (int32_t d = 0; d < view.components; ++d) out[i * view.components + d] = peri__view_at(&view, i, d);
        return;
    }
    if (field == PERI_ENERGY_DENSITY) {
        (void)peri__elastic_energy(b, out);
        for (int64_t i = 0; i < m->points; ++i) out[i] *= m->stress;
        return;
    }
    if (field == PERI_REACTION) {
        peri__read_reactions(b, out);
        return;
    }
    if (field >= PERI_DILATATION) {
        peri__gradients gradients = { b, field, out };
        peri__refresh(b);
        peri__for_points(b, m->points, 8 * m->width, peri__gradients_block, &gradients, NULL);
        return;
    }
    (void)peri__stored_view(b, PERI_POSITION, &view);
    (void)peri__stored_view(b, PERI_DISPLACEMENT, &moved);
    for (int64_t i = 0; i < m->points; ++i) switch (field) {
        case PERI_MATERIAL: out[i] = m->material[i]; break;
        case PERI_FAMILY_SIZE: out[i] = m->count[i]; break;
        case PERI_DAMAGE: out[i] = peri__damage(b, i, 0); break;
        case PERI_DAMAGE_GROWN: out[i] = peri__damage(b, i, 1); break;
        default:
            for (int32_t d = 0; d < m->dim; ++d) out[i * m->dim + d] = peri__view_at(&view, i, d) + peri__view_at(&moved, i, d);
        }
}

/* Forces are what a write or a cut can leave out of date. */
static int32_t peri__ready_field(peri_body *b, int32_t field) {
    if (peri__components(field, b->dim) == 0) return peri__fail(b, PERI_ERROR_FIELD, "field", field, 0.0);
    return (field == PERI_FORCE_DENSITY || field == PERI_REACTION) && b->running < 2 ? peri__update_force(b) : PERI_OK;
}

PERI_API int32_t peri_read(peri_body *b, int32_t field, double *out, int64_t capacity) {
    PERI_NEED_BUILT(b);
    int32_t status = peri__ready_field(b, field);
    if (status < 0) return status;
    PERI_NEED(b, out, "out");
    int64_t need = peri_field_size(b, field);
    if (capacity < need) return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)need);
    peri__compute(b, field, out);
    return PERI_OK;
}

PERI_API int32_t peri_view_field(peri_body *b, int32_t field, peri_view *view) {
    PERI_NEED_BUILT(b);
    int32_t status = peri__ready_field(b, field);
    if (status < 0) return status;
    PERI_NEED(b, view, "view");
    memset(view, 0, sizeof *view);
    if (peri__stored_view(b, field, view)) return PERI_OK;
    int32_t components = peri__components(field, b->dim);
    if (!b->derived[field]) b->derived[field] = (double *)peri__new(&b->memory, b->model->points * components, sizeof(double));
    if (!b->derived[field]) return peri__fail(b, PERI_ERROR_MEMORY, "field", field, 0.0);
    peri__compute(b, field, b->derived[field]);
    view->data = b->derived[field];
    view->components = components;
    view->point_stride = components;
    view->component_stride = 1;
    view->type = PERI_F64;
    view->scale = 1.0;
    return PERI_OK;
}

PERI_API int32_t peri_write(peri_body *b, int32_t field, const double *in, int64_t count) {
    PERI_NEED_IDLE(b);
    if (field != PERI_DISPLACEMENT && field != PERI_VELOCITY) return peri__fail(b, PERI_ERROR_FIELD, "field", field, 0.0);
    PERI_NEED(b, in, "in");
    const peri__model *m = b->model;
    if (count != m->points * m->dim) return peri__fail(b, PERI_ERROR_CAPACITY, "count", -1, (double)(m->points * m->dim));
    peri_view view;
    (void)peri__stored_view(b, field, &view);
    void *data = field == PERI_VELOCITY ? b->v : b->u;
    int32_t status = peri__check_state(b, data, in, count, view.scale, "in");
    if (status < 0) return status;
    peri__touch(b);
    for (int64_t i = 0; i < m->points; ++i)
        for (int32_t d = 0; d < m->dim; ++d)
            peri__put_real(data, b->f32, d * m->stride + i, in[i * m->dim + d] / view.scale);
    return PERI_OK;
}

PERI_API int32_t peri_read_energy(peri_body *b, peri_energy *e) {
    PERI_NEED_BUILT(b);
    PERI_NEED(b, e, "energy");
    const peri__ledger *l = &b->ledger;
    double unit = b->model->energy;
    memset(e, 0, sizeof *e);
    e->kinetic = peri__kinetic_energy(b) * unit;
    e->elastic = peri__elastic_energy(b, NULL) * unit;
    e->fracture = l->fracture * unit;
    if (!b->desc.ledger) return PERI_OK;
    e->external = l->external * unit;
    e->obstacle = l->obstacle * unit;
    e->damping = l->damping * unit;
    e->initial = l->initial * unit;
    if (l->pending) e->initial += e->kinetic + e->elastic - l->before * unit;
    e->error = e->initial + e->external + e->obstacle - e->kinetic - e->elastic - e->damping - e->fracture;
    return PERI_OK;
}

PERI_API int32_t peri_read_momentum(peri_body *b, double *linear, double *angular) {
    PERI_NEED_BUILT(b);
    const peri__model *m = b->model;
    peri_view x, u, v;
    double total[3] = { 0.0, 0.0, 0.0 }, turn[3] = { 0.0, 0.0, 0.0 };
    double thickness = m->dim == 3 ? 1.0 : b->desc.thickness, unit = m->density * pow(m->length, m->dim) * thickness;
    (void)peri__stored_view(b, PERI_POSITION, &x);
    (void)peri__stored_view(b, PERI_DISPLACEMENT, &u);
    (void)peri__stored_view(b, PERI_VELOCITY, &v);
    for (int64_t i = 0; i < m->points; ++i) {
        double y[3] = { 0.0, 0.0, 0.0 }, p[3] = { 0.0, 0.0, 0.0 }, mass = m->rho[m->material[i]] * m->volume[i] * unit, cross[3];
        for (int32_t d = 0; d < m->dim; ++d) {
            y[d] = peri__view_at(&x, i, d) + peri__view_at(&u, i, d);
            p[d] = mass * peri__view_at(&v, i, d);
            total[d] += p[d];
        }
        peri__cross(y, p, cross);
        for (int d = 0; d < 3; ++d) turn[d] += cross[d];
    }
    if (linear) memcpy(linear, total, (size_t)m->dim * sizeof(double));
    if (angular && m->dim == 3) memcpy(angular, turn, sizeof turn);
    if (angular && m->dim == 2) *angular = turn[2];
    return PERI_OK;
}
