/* SPDX-License-Identifier: MIT */
/* clone.c - copies of a body, and what there is to ask of one. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Copies the state of `from` into the empty body b, which shares its model. 0 where memory is short. */
static int peri__copy_state(peri_body *b, const peri_body *from) {
    const peri__memory *memory = &b->memory;
    const peri__model *m = b->model;
    int64_t vector = m->stride * m->dim;
    peri__array arrays[PERI_ARRAYS];
    int ok = 1;
#define PERI_COPY_(member, count, size)                                                                                \
    if (from->member) {                                                                                                \
        void *copy_ = peri__copy(memory, from->member, count, size);                                                   \
        ok = ok && copy_;                                                                                              \
        memcpy(&b->member, &copy_, sizeof copy_);                                                                      \
    }
    b->u = peri__new_vector(b, memory);
    b->v = peri__new_vector(b, memory);
    b->f = peri__new_vector(b, memory);
    ok = b->u && b->v && b->f;
    if (ok) {
        memcpy(b->u, from->u, (size_t)vector * peri__real(b));
        memcpy(b->v, from->v, (size_t)vector * peri__real(b));
        memcpy(b->f, from->f, (size_t)vector * peri__real(b));
    }
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS; ++k) {
        const void *own = peri__array_of(from, &arrays[k]);
        void *made = own ? peri__copy(memory, own, arrays[k].count, arrays[k].size) : NULL;
        ok = ok && (made || !own);
        peri__set_array(b, &arrays[k], made);
    }
    if (from->contact) {
        b->contact = peri__copy_contact(b, from->contact);
        ok = ok && b->contact;
    }
    if (from->obstacle_capacity > 0) b->obstacles = (peri__obstacle *)peri__new(memory, from->obstacle_capacity, sizeof *b->obstacles);
    ok = ok && (b->obstacles || from->obstacle_capacity == 0);
    if (b->obstacles) b->obstacle_capacity = from->obstacle_capacity;
    for (int64_t k = 0; b->obstacles && k < from->obstacle_count; ++k) {
        peri__obstacle *o = &b->obstacles[k];
        *o = from->obstacles[k];
        o->solid.mesh = NULL;
        o->free = NULL;
        o->kept = o->tally = NULL;
        b->obstacle_count = k + 1;
        PERI_COPY_(obstacles[k].solid.mesh, from->obstacles[k].solid.mesh->bytes, 1)
        PERI_COPY_(obstacles[k].free, 1, sizeof *o->free)
        PERI_COPY_(obstacles[k].kept, m->points * PERI_KEPT, sizeof *o->kept)
        PERI_COPY_(obstacles[k].tally, m->blocks * PERI_TALLIED, sizeof *o->tally)
        if (o->solid.mesh) peri__bind_mesh(o->solid.mesh);
    }

    b->sets = (peri__set *)peri__new(memory, from->set_capacity, sizeof *b->sets);
    b->loads = (peri__load *)peri__new(memory, from->load_capacity, sizeof *b->loads);
    if (b->sets) b->set_capacity = from->set_capacity;
    if (b->loads) b->load_capacity = from->load_capacity;
    for (int64_t k = 0; b->sets && k < from->set_count; ++k) {
        b->sets[k] = from->sets[k];
        b->sets[k].name = NULL;
        b->sets[k].points = NULL;
        PERI_COPY_(sets[k].name, from->sets[k].name_bytes, 1)
        PERI_COPY_(sets[k].points, from->sets[k].all, sizeof(int32_t))
        b->set_count = k + 1;
    }
    for (int64_t k = 0; b->loads && k < from->load_count; ++k) {
        b->loads[k] = from->loads[k];
        b->loads[k].value = b->loads[k].force = b->loads[k].spread = NULL;
        b->loads[k].owned = NULL;
        b->loads[k].all = NULL;
        PERI_COPY_(loads[k].all, from->loads[k].count, sizeof(int32_t))
        PERI_COPY_(loads[k].value, from->loads[k].count * m->dim, sizeof(double))
        PERI_COPY_(loads[k].force, PERI__SUPPORT_PLANES * from->loads[k].count * m->dim, sizeof(double))
        PERI_COPY_(loads[k].spread, from->loads[k].count * m->dim * m->dim, sizeof(double))
        PERI_COPY_(loads[k].owned, from->loads[k].count, 1)
        b->load_count = k + 1;
    }
#undef PERI_COPY_
    return ok && b->sets && b->loads;
}

PERI_API int32_t peri_body_clone(const peri_body *from, peri_body **copy, peri_error *error) {
    peri_body *b;
    (void)peri__set_error(error, PERI_OK, "", -1, 0.0);
    if (copy) *copy = NULL;
    if (!from || !copy) return peri__set_error(error, PERI_ERROR_ARGUMENT, from ? "copy" : "body", -1, 0.0);
    if (!from->model) return peri__set_error(error, PERI_ERROR_ORDER, "peri_build", -1, 0.0);
    if (from->running > PERI__IN_FRAME) return peri__set_error(error, PERI_ERROR_ORDER, "peri_unlock", -1, 0.0);
    b = (peri_body *)peri__new(&from->memory, 1, sizeof *b);
    if (!b) return peri__set_error(error, PERI_ERROR_MEMORY, "body", -1, 0.0);
    peri__start_body(b, &from->desc);
    memcpy(b->materials, from->materials, sizeof b->materials);
    b->material_count = from->material_count;
    b->number = from->number;
    b->model = from->model;
    b->ops = from->ops;
    b->classes = from->classes;
    b->largest_row_sum = from->largest_row_sum;
    b->sharp = from->sharp;
    b->least_strength = from->least_strength;
    b->row_sum_factor = from->row_sum_factor;
    b->softens = from->softens;
    b->side_count = from->side_count;
    b->on_break = from->on_break;
    b->break_user = from->break_user;
    memcpy(b->mean_gradient, from->mean_gradient, sizeof b->mean_gradient);
    b->now = from->now;
    if (b->now.pushed) b->now.stale |= PERI__STALE_FORCE | PERI__STALE_BALANCE; /* nobody pushes the copy */
    if (from->running) b->now.torn = 0; /* on_frame comes at a whole step */
    (void)peri__count_users(&b->model->users, 1);
    int ok = peri__copy_state(b, from);
    if (ok && from->interface_count > 0) {
        b->interfaces = (peri__interface *)peri__copy(&b->memory, from->interfaces, from->interface_capacity,
                                                      sizeof *b->interfaces);
        ok = b->interfaces != NULL;
        if (ok) {
            b->interface_count = from->interface_count;
            b->interface_capacity = from->interface_capacity;
        }
    }
    if (ok && from->bond_law_count > 0) {
        b->bond_laws = (peri__bond_law *)peri__copy(&b->memory, from->bond_laws, from->bond_law_capacity, sizeof *b->bond_laws);
        ok = b->bond_laws != NULL;
        if (ok) b->bond_law_capacity = from->bond_law_capacity;
        if (ok) b->bond_law_count = from->bond_law_count;
    }
    if (!ok) {
        peri_body_destroy(b);
        return peri__set_error(error, PERI_ERROR_MEMORY, "state", -1, 0.0);
    }
    *copy = b;
    return PERI_OK;
}

/* ---- counts ------------------------------------------------------------------------------------------------------- */

PERI_API int32_t peri_dimension(const peri_body *b) { return b ? b->dim : 0; }

PERI_API int64_t peri_point_count(const peri_body *b) {
    return !b ? 0 : b->model ? b->model->points : b->setup.point_count;
}

PERI_API int32_t peri_family_width(const peri_body *b) { return b && b->model ? b->model->width : 0; }

PERI_API int64_t peri_entry_count(const peri_body *b) { return b && b->model ? b->model->bonds : 0; }

PERI_API int64_t peri_bond_count(const peri_body *b) { return peri_entry_count(b) / 2; }

#ifdef PERI_GENERIC
#define PERI_OTHER_VECTORS "16 bytes"
#else
#define PERI_OTHER_VECTORS "plain"
#endif

PERI_API const char *peri_kernel_text(const peri_body *b) {
    static const char *const names[4][3] = {
#if defined(PERI_ISA)
        { "columns, SSE2", "columns, AVX2", "columns, AVX-512" },
        { "list, SSE2", "list, AVX2", "list, AVX-512" },
#else
        { "columns, " PERI_OTHER_VECTORS, "", "" },
        { "list, " PERI_OTHER_VECTORS, "", "" },
#endif
        { "rows", "rows", "rows" },
        { "reference", "reference", "reference" },
    };
    const peri__model *m = b ? b->model : NULL;
    if (!m) return "";
    const int listed = m->record_reals ? 1 : b->desc.kernel == PERI_KERNEL_REFERENCE || m->centroid ? 3 : 2;
    return names[m->stencil.columns ? 0 : listed][m->stencil.isa];
}

/* Half of the directed bonds, of all parts. */
static int64_t peri__count_of_parts(const peri_body *b, int64_t directed) {
    double sum = (double)directed;
    const int32_t status = b->model && b->model->part ? peri__share_total((peri_body *)b, PERI_OK, 1, &sum) : PERI_OK;
    return status < 0 ? status : b->model && b->model->part ? (int64_t)(0.5 * sum) : directed / 2;
}

PERI_API int64_t peri_cut_count(const peri_body *b) { return b ? peri__count_of_parts(b, b->now.cut) : 0; }

PERI_API int64_t peri_broken_count(const peri_body *b) { return b ? peri__count_of_parts(b, b->now.broken) : 0; }

PERI_API int64_t peri_step_count(const peri_body *b) { return b ? b->now.steps : 0; }

PERI_API double peri_time(const peri_body *b) { return b ? b->now.time : 0.0; }

PERI_API double peri_load_factor(const peri_body *b) { return b && b->now.loaded ? b->now.load_factor : 0.0; }

PERI_API int32_t peri_get_families(peri_body *b, int64_t first, int64_t count, int32_t *rows, int64_t capacity) {
    PERI_NEED_BUILT(b);
    PERI_NEED(b, rows, "rows");
    if (first < 0 || count < 0 || first > b->model->points || count > b->model->points - first)
        return peri__fail(b, PERI_ERROR_INDEX, "first", first, (double)count);
    if (capacity < count * b->model->width)
        return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)(count * b->model->width));
    for (int64_t i = first; i < first + count; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        memcpy(rows, row.ids, (size_t)row.count * sizeof *rows);
        if (b->model->order) peri__sort_row(rows, row.count);
        for (int64_t k = row.count; k < b->model->width; ++k) rows[k] = (int32_t)i;
        rows += b->model->width;
    }
    return PERI_OK;
}
