/* SPDX-License-Identifier: MIT */
/* fields.c - fields by copy and by view, the ledger, the momenta.
   A field more is its number in peri.h, its entry in the list below, and the function that the entry names. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* X(name, number, components, unit, way, what, ensure). All ways leave the unit to the list:
     view     peri__view_what points to what is stored
     point    peri__point_what computes the numbers of a point
     family   peri__family_what does so from its family, on any thread
     read     peri__read_what computes those of all points in one pass
   ensure: what a write or a cut leaves out of date, which is made up for first. */
static int32_t peri__ensure_none(peri_body *b) { return (void)b, PERI_OK; }
/* What is made of bonds wants ghosts that are where their owners are. */
static int32_t peri__ensure_ghosts(peri_body *b) { return b->model->part ? peri__ensure_force(b) : PERI_OK; }
static int32_t peri__ensure_fragments(peri_body *b) { return peri__label_fragments(b); }

#define PERI_FIELD_LIST(X)                                                                                             \
    X(POSITION, 2001, dim, m->length, view, position, none)                                                                  \
    X(DISPLACEMENT, 2002, dim, m->length, view, displacement, none)                                                          \
    X(VELOCITY, 2003, dim, peri__velocity_unit(m), view, velocity, none)                                                     \
    X(FORCE_DENSITY, 2004, dim, peri__force_unit(m), view, force_density, force)                                              \
    X(VOLUME, 2005, 1, pow(m->length, m->dim), view, volume, none)                                                           \
    X(MATERIAL, 2006, 1, 1.0, point, material, none)                                                                          \
    X(FAMILY_SIZE, 2007, 1, 1.0, point, family_size, none)                                                                    \
    X(DAMAGE, 2008, 1, 1.0, point, damage, none)                                                                              \
    X(DAMAGE_GROWN, 2009, 1, 1.0, point, damage_grown, none)                                                                  \
    X(ENERGY_DENSITY, 2010, 1, m->stress, read, energy_density, ghosts)                                                       \
    X(CURRENT_POSITION, 2011, dim, 1.0, point, current_position, none) /* the sum of two views, which have their units */ \
    X(DILATATION, 2012, 1, 1.0, family, dilatation, ghosts)                                                                     \
    X(STRAIN, 2013, PERI_PACKED(dim), 1.0, family, strain, ghosts)                                                              \
    X(STRESS, 2014, PERI_PACKED(dim), m->stress, family, stress, ghosts)                                                        \
    X(FORCE_STRESS, 2015, PERI_PACKED(dim), m->stress, family, force_stress, ghosts)                                            \
    X(REACTION, 2016, dim, peri__force_unit(m), read, reaction, force)                                                   \
    X(FRAGMENT, 2017, 1, 1.0, point, fragment, fragments)                                                        \
    X(MASS, 2018, 1, 1.0, point, mass, none)                                                                              \
    X(DENSITY, 2019, 1, 1.0, point, density, none)                                                                        \
    X(HELD, 2020, dim, 1.0, read, held, none)                                                                                \
    X(EIGENSTRAIN, 2021, 1, 1.0, point, eigenstrain, none)                                                                    \
    X(STRENGTH, 2022, 1, 1.0, point, strength, none)                                                                          \
    X(STIFFNESS, 2023, 1, 1.0, point, stiffness, none)                                                                      \
    X(DEFORMATION_GRADIENT, 2024, dim * dim, 1.0, family, deformation_gradient, ghosts)

#define PERI_FIELD_NUMBER_(name, number, ...) PERI_SAME_NUMBER_(FIELD_##name, PERI_FIELD_##name == (number))
PERI_FIELD_LIST(PERI_FIELD_NUMBER_)
PERI_SAME_COUNT(field, PERI_FIELD_LIST, peri__count_field);

/* Numbers per point of a field, 0 where there is no such field. */
static int32_t peri__components(int32_t field, int32_t dim) {
#define PERI_COMPONENTS_CASE_(name, number, components, unit, way, what, ensure)                                       \
    case PERI_FIELD_##name: return components;
    switch (field) {
        PERI_FIELD_LIST(PERI_COMPONENTS_CASE_)
    default: return 0;
    }
#undef PERI_COMPONENTS_CASE_
}

static double peri__unit_of(const peri__model *m, int32_t field) {
#define PERI_UNIT_CASE_(name, number, components, unit, way, what, ensure)                                             \
    case PERI_FIELD_##name: return unit;
    switch (field) {
        PERI_FIELD_LIST(PERI_UNIT_CASE_)
    default: return 1.0;
    }
#undef PERI_UNIT_CASE_
}

PERI_API int64_t peri_size_of_field(const peri_body *b, int32_t field) {
    PERI_NEED_BODY(b);
    if (!b->model) return peri__fail_const(b, PERI_ERROR_ORDER, "peri_build", -1, 0.0);
    if (!PERI_IS_ONE_OF(field, field)) return peri__fail_const(b, PERI_ERROR_CHOICE, "field", -1, field);
    return b->model->points * peri__components(field, b->dim);
}

/* ---- what is stored ----------------------------------------------------------------------------------------------- */

static void peri__view_position(const peri_body *b, peri_view *view) {
    view->data = b->model->x;
    memcpy(view->offset, b->model->origin, sizeof view->offset);
}

static void peri__view_displacement(const peri_body *b, peri_view *view) { view->data = b->u; }
static void peri__view_velocity(const peri_body *b, peri_view *view) { view->data = b->v; }
static void peri__view_force_density(const peri_body *b, peri_view *view) { view->data = b->f; }

static void peri__view_volume(const peri_body *b, peri_view *view) {
    view->data = b->model->volume;
    view->type = PERI_TYPE_F64;
}

/* All of a view but what it points to. */
static void peri__frame_view(const peri_body *b, int32_t field, peri_view *view) {
    const peri__model *m = b->model;
    view->count = m->points;
    view->point_stride = 1;
    view->component_stride = m->stride;
    view->components = peri__components(field, b->dim);
    view->type = b->f32 ? PERI_TYPE_F32 : PERI_TYPE_F64;
    view->scale = peri__unit_of(m, field);
    view->offset[0] = view->offset[1] = view->offset[2] = 0.0;
}

static double peri__view_at(const peri_view *view, int64_t i, int32_t d) {
    int64_t at = i * view->point_stride + d * view->component_stride;
    return view->offset[d] + view->scale * peri__get_real(view->data, view->type == PERI_TYPE_F32, at);
}

/* ---- what is computed --------------------------------------------------------------------------------------------- */

static void peri__point_material(const peri_body *b, int64_t i, double *out) { *out = b->model->material[i] + 1; /* PERI_ID_INDEX */ }

static void peri__point_family_size(const peri_body *b, int64_t i, double *out) { *out = b->model->count[i]; }

/* Damage of point i ([L]): 1 - intact/all, both sums of beta V_j over the family; uncut_only: over bonds not cut at the start. */
static double peri__damage(const peri_body *b, int64_t i, int uncut_only) {
    const peri__model *m = b->model;
    double all = 0.0, intact = 0.0;
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        double part = row.partial_volume ? (double)row.partial_volume[k] : m->volume[row.ids[k]];
        if (uncut_only && b->uncut && !(b->uncut[i * m->words + k / 32] >> (k % 32) & 1)) continue;
        all += part;
        if (peri__is_alive(b, i, k)) intact += b->history ? part * peri__bond_left(b, i, &row, k) : part;
    }
    return all > 0.0 ? 1.0 - intact / all : 0.0;
}

static void peri__point_damage(const peri_body *b, int64_t i, double *out) { *out = peri__damage(b, i, 0); }

static void peri__point_damage_grown(const peri_body *b, int64_t i, double *out) { *out = peri__damage(b, i, 1); }

static void peri__point_current_position(const peri_body *b, int64_t i, double *out) {
    peri_view at, moved;
    peri__frame_view(b, PERI_FIELD_POSITION, &at);
    peri__view_position(b, &at);
    peri__frame_view(b, PERI_FIELD_DISPLACEMENT, &moved);
    peri__view_displacement(b, &moved);
    for (int32_t d = 0; d < b->dim; ++d) out[d] = peri__view_at(&at, i, d) + peri__view_at(&moved, i, d);
}

static void peri__point_fragment(const peri_body *b, int64_t i, double *out) { *out = b->fragment_of[i]; }

static void peri__point_density(const peri_body *b, int64_t i, double *out) { *out = peri__density_told(b, i); }

static void peri__point_mass(const peri_body *b, int64_t i, double *out) {
    const peri__model *m = b->model;
    *out = m->volume[i] * (pow(m->length, m->dim) * (m->dim == 3 ? 1.0 : b->desc.thickness));
    *out *= b->density ? b->density[i] * m->density : b->materials[m->material[i]].density;
}

static void peri__point_eigenstrain(const peri_body *b, int64_t i, double *out) { *out = peri__eigenstrain_at(b, i); }

static void peri__point_strength(const peri_body *b, int64_t i, double *out) { *out = peri__field_at(b, b->strength, i, 1.0); }

static void peri__point_stiffness(const peri_body *b, int64_t i, double *out) { *out = peri__stiffness_at(b, i); }

static void peri__read_energy_density(peri_body *b, double *out) { (void)peri__elastic_energy(b, out); }

static void peri__read_reaction(peri_body *b, double *out) { peri__read_reactions(b, out); }

static void peri__read_held(peri_body *b, double *out) {
    const peri__model *m = b->model;
    memset(out, 0, (size_t)(m->points * m->dim) * sizeof *out);
    for (int64_t s = 0; s < b->load_count; ++s)
        for (int64_t k = 0; b->loads[s].owned && k < b->loads[s].count; ++k)
            for (int32_t d = 0; d < m->dim; ++d)
                if (b->loads[s].owned[k] >> d & 1) out[peri__set_point(b, b->loads[s].set, k) * m->dim + d] = 1.0;
}

/* ---- any field ---------------------------------------------------------------------------------------------------- */

/* One of the four functions. */
typedef struct peri__field {
    const char *name;
    int32_t (*ensure)(peri_body *b);
    void (*view)(const peri_body *b, peri_view *view);
    void (*point)(const peri_body *b, int64_t i, double *out); /* [components]                                           */
    peri__point_fn family;
    void (*read)(peri_body *b, double *out); /* [points*components]                                                      */
} peri__field;

#define PERI_FIELD_ENTRY_(name, number, components, unit, way, what, ensure)                                           \
    [(number) - peri__first_field] = { #what, peri__ensure_##ensure, .way = peri__##way##_##what },
static const peri__field peri__fields[peri__count_field] = { PERI_FIELD_LIST(PERI_FIELD_ENTRY_) };
#undef PERI_FIELD_ENTRY_

/* Fills a view of a stored field; 0 where the field is not stored. */
static int peri__stored_view(const peri_body *b, int32_t field, peri_view *view) {
    if (!peri__fields[field - peri__first_field].view) return 0;
    peri__frame_view(b, field, view);
    peri__fields[field - peri__first_field].view(b, view);
    return 1;
}

/* A field in the user's units and order; out is [peri_size_of_field]. Fails where a law of bonds or a stress of the caller does. */
static int32_t peri__compute(peri_body *b, int32_t field, double *out) {
    const int64_t count = peri_size_of_field(b, field);
    const double unit = peri__unit_of(b->model, field);
    peri_view view;
    if (peri__stored_view(b, field, &view)) {
        for (int64_t i = 0; i < view.count; ++i)
            for (int32_t d = 0; d < view.components; ++d) out[i * view.components + d] = peri__view_at(&view, i, d);
        return PERI_OK;
    }
    const peri__field *how = &peri__fields[field - peri__first_field];
    const int32_t components = peri__components(field, b->dim);
    for (int64_t i = 0; how->point && i < b->model->points; ++i) how->point(b, i, &out[i * components]);
    if (how->family) peri__read_gradients(b, how->family, components, out);
    if (how->read) how->read(b, out);
    for (int64_t k = 0; unit != 1.0 && k < count; ++k) out[k] *= unit;
    return peri__heed_laws(b);
}

PERI_API int32_t peri_get_field(peri_body *b, int32_t field, double *out, int64_t capacity) {
    PERI_NEED_BUILT(b);
    PERI_NEED_CHOICE(b, field, field);
    PERI_NEED(b, out, "out");
    const int64_t need = peri_size_of_field(b, field);
    if (capacity < need) return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)need);
    const int32_t status = peri__fields[field - peri__first_field].ensure(b);
    if (status < 0) return status;
    return peri__compute(b, field, out);
}

PERI_API int32_t peri_view_field(peri_body *b, int32_t field, peri_view *view) {
    PERI_NEED_BUILT(b);
    PERI_NEED_CHOICE(b, field, field);
    PERI_NEED(b, view, "view");
    const int known = b->fragment_of != NULL;
    int32_t status = peri__fields[field - peri__first_field].ensure(b);
    if (status < 0) return status;
    memset(view, 0, sizeof *view);
    if (peri__stored_view(b, field, view)) return PERI_OK;
    int32_t components = peri__components(field, b->dim);
    peri__derived *derived = &b->derived[field - peri__first_field];
    if (!derived->data) derived->data = (double *)peri__new(&b->memory, b->model->points * components, sizeof(double));
    if (!derived->data) {
        peri__forget_fragments(b, known);
        return peri__fail(b, PERI_ERROR_MEMORY, "field", field, 0.0);
    }
    derived->components = components;
    status = peri__compute(b, field, derived->data);
    if (status < 0) {
        memset(view, 0, sizeof *view);
        return status;
    }
    view->data = derived->data;
    view->count = b->model->points;
    view->components = components;
    view->point_stride = components;
    view->component_stride = 1;
    view->type = PERI_TYPE_F64;
    view->scale = 1.0;
    return PERI_OK;
}

/* Does a copy of the field tell `in` of component d of point i? Then what is stored stays: several reals in inner units may be one number
   in those of the caller, and what is read and written back is to change no bit. */
static int peri__tells(const peri_view *view, int64_t i, int32_t d, const double *in) {
    return peri__view_at(view, i, d) == in[i * view->components + d];
}

PERI_API int32_t peri_set_field(peri_body *b, int32_t field, const double *in, int64_t count) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_CHOICE(b, field, field);
    if (peri__is_material_field(field)) {
        PERI_NEED(b, in, "in");
        if (count != b->model->points) return peri__fail(b, PERI_ERROR_CAPACITY, "count", -1, (double)b->model->points);
        return peri__set_material_field(b, field, in);
    }
    PERI_NEED_IDLE(b);
    if (field != PERI_FIELD_DISPLACEMENT && field != PERI_FIELD_VELOCITY) return peri__fail(b, PERI_ERROR_FIELD, "field", -1, field);
    PERI_NEED(b, in, "in");
    const peri__model *m = b->model;
    if (count != m->points * m->dim) return peri__fail(b, PERI_ERROR_CAPACITY, "count", -1, (double)(m->points * m->dim));
    peri_view view;
    (void)peri__stored_view(b, field, &view);
    void *data = field == PERI_FIELD_VELOCITY ? b->v : b->u;
    int32_t status = peri__check_state(b, data, in, count, view.scale, "in", NULL);
    if (status < 0) return status;
    int64_t i = 0;
    for (int32_t d = 0; i < m->points && peri__tells(&view, i, d, in);)
        if (++d == m->dim) d = 0, ++i;
    if (i == m->points) return PERI_OK; /* nothing changes, and so nothing is stale                                       */
    status = peri__alter(b, PERI__MOTION);
    if (status < 0) return status;
    for (; i < m->points; ++i)
        for (int32_t d = 0; d < m->dim; ++d)
            if (!peri__tells(&view, i, d, in)) peri__put_real(data, b->f32, d * m->stride + i, in[i * m->dim + d] / view.scale);
    return PERI_OK;
}

/* What a ledger does not account for. */
static double peri__imbalance(const peri_energy *e) {
    return e->initial + e->external + e->obstacle - e->kinetic - e->elastic - e->contact - e->damping - e->fracture;
}

/* The ledger of all parts, of which *e has what this one stores. */
static int32_t peri__share_energy(peri_body *b, int32_t status, peri_energy *e) {
    const peri__ledger *l = &b->now.ledger;
    const double unit = b->model->energy;
    double sum[7] = { e->kinetic, e->elastic, l->fracture * unit, l->external * unit, l->obstacle * unit, l->damping * unit,
                      l->initial * unit };
    if (b->now.stale & PERI__STALE_LEDGER) sum[6] += e->kinetic + e->elastic - l->before * unit;
    status = peri__share_total(b, status, 7, sum);
    memset(e, 0, sizeof *e);
    if (status < 0) return status;
    e->kinetic = sum[0];
    e->elastic = sum[1];
    e->fracture = sum[2];
    if (!b->desc.ledger) return PERI_OK;
    e->external = sum[3];
    e->obstacle = sum[4];
    e->damping = sum[5];
    e->initial = sum[6];
    e->error = peri__imbalance(e);
    return PERI_OK;
}

PERI_API int32_t peri_get_energy(peri_body *b, peri_energy *e) {
    PERI_NEED_BUILT(b);
    PERI_NEED(b, e, "energy");
    const peri__ledger *l = &b->now.ledger;
    double unit = b->model->energy;
    memset(e, 0, sizeof *e);
    int32_t status = b->running > PERI__IN_FRAME ? PERI_OK : peri__share_ghosts(b);
    e->kinetic = peri__kinetic_energy(b) * unit;
    e->elastic = peri__elastic_energy(b, NULL) * unit;
    if (status == PERI_OK) status = peri__heed_laws(b);
    if (b->model->part) return peri__share_energy(b, status, e);
    if (status < 0) return status;
    if (b->contact && !peri__ready_contact(b)) return peri__fail(b, PERI_ERROR_MEMORY, "contact", -1, 0.0);
    e->contact = peri__contact_energy(b) * unit;
    e->fracture = l->fracture * unit;
    if (!b->desc.ledger) return PERI_OK;
    e->external = l->external * unit;
    e->obstacle = l->obstacle * unit;
    e->damping = l->damping * unit;
    e->initial = l->initial * unit;
    if (b->now.stale & PERI__STALE_LEDGER) e->initial += e->kinetic + e->elastic + e->contact - l->before * unit;
    e->error = peri__imbalance(e);
    return PERI_OK;
}

PERI_API int32_t peri_get_momentum(peri_body *b, double *linear, double *angular) {
    PERI_NEED_BUILT(b);
    const peri__model *m = b->model;
    peri_view x, u, v;
    double total[3] = { 0.0, 0.0, 0.0 }, turn[3] = { 0.0, 0.0, 0.0 };
    double thickness = m->dim == 3 ? 1.0 : b->desc.thickness, unit = m->density * pow(m->length, m->dim) * thickness;
    (void)peri__stored_view(b, PERI_FIELD_POSITION, &x);
    (void)peri__stored_view(b, PERI_FIELD_DISPLACEMENT, &u);
    (void)peri__stored_view(b, PERI_FIELD_VELOCITY, &v);
    for (int64_t i = 0; i < m->points; ++i) {
        double y[3] = { 0.0, 0.0, 0.0 }, p[3] = { 0.0, 0.0, 0.0 }, mass = peri__mass(b, i) * unit, cross[3];
        if (peri__is_ghost(m, i)) continue;
        for (int32_t d = 0; d < m->dim; ++d) {
            y[d] = peri__view_at(&x, i, d) + peri__view_at(&u, i, d);
            p[d] = mass * peri__view_at(&v, i, d);
            total[d] += p[d];
        }
        peri__cross(y, p, cross);
        for (int d = 0; d < 3; ++d) turn[d] += cross[d];
    }
    double both[6] = { total[0], total[1], total[2], turn[0], turn[1], turn[2] };
    const int32_t status = peri__share_total(b, PERI_OK, 6, both);
    if (status < 0) return status;
    memcpy(total, both, sizeof total);
    memcpy(turn, both + 3, sizeof turn);
    if (linear) memcpy(linear, total, (size_t)m->dim * sizeof(double));
    if (angular && m->dim == 3) memcpy(angular, turn, sizeof turn);
    if (angular && m->dim == 2) *angular = turn[2];
    return PERI_OK;
}
