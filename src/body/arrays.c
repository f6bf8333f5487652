/* SPDX-License-Identifier: MIT */
/* arrays.c - what a body keeps per point and per bond: which arrays there are, how large, what for, and which of them a scene needs. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* A state vector, [dim][stride] with a margin before and after. */
static int64_t peri__vector_reals(const peri__model *m) { return m->stride * m->dim + 2 * m->margin; }

/* What the force of laws needs of every point: p, and Q where there are tensors. */
static int64_t peri__response_reals(const peri__model *m) {
    return (m->gathers & PERI__GRADIENT ? 1 + m->dim * m->dim : 1) * m->stride + 2 * m->margin;
}

/* Entries of the arrays of bonds, see peri__bond_slot. */
static int64_t peri__bond_slots(const peri__model *m) { return m->stencil.columns ? m->stencil.columns * PERI_GROUP : m->entries; }

/* The entries of peri_memory, in its order. */
typedef enum peri__purpose {
    PERI__POINTS,
    PERI__FAMILIES,
    PERI__DAMAGE,
    PERI__STATE,
    PERI__LAWS,
    PERI__LOADS,
    PERI__FIELDS,
    PERI__PURPOSES
} peri__purpose;

/* What peri_reset and checkpoints make of an array of a body. */
typedef enum peri__role {
    PERI__SCRATCH, /* nothing: it is filled before it is read, or follows from others                                     */
    PERI__SCENE,   /* what the caller has set; peri_reset leaves it                                                       */
    PERI__BONDS_LEFT, /* flags of bonds, all set where there is no array: saved                                          */
    PERI__FOLLOWS, /* follows from the rest but for the last digits, which depend on the way: saved                       */
    PERI__HISTORY, /* saved; 0 after peri_reset                                                                           */
    PERI__FIELD,   /* what the caller has set and may set anew as time goes on: saved; peri_reset leaves it                */
    PERI__RESTING  /* 0 between steps                                                                                     */
} peri__role;

/* An array: the name of its member, where its pointer is in the model or the body, how much it points to, whether peri_build takes it, what
   for, and of a body its role. */
typedef struct peri__array {
    const char   *name;
    size_t        place;
    int64_t       count;
    size_t        size;
    int           wanted;
    peri__purpose purpose;
    peri__role    role;
} peri__array;
#define PERI_ARRAYS 52       /* of a body, taken where a scene has use for them                                           */
#define PERI_LIST_ARRAYS 8   /* of a model: the list of families, then                                                    */
#define PERI_MODEL_ARRAYS 22 /* with all others                                                                           */

static void *peri__pointer_at(const void *owner, size_t place) {
    void *pointer;
    memcpy(&pointer, (const char *)owner + place, sizeof pointer);
    return pointer;
}

static void peri__set_pointer_at(void *owner, size_t place, void *pointer) {
    memcpy((char *)owner + place, &pointer, sizeof pointer);
}

/* A second name for the weights holds nothing. */
static void *peri__model_array(const peri__model *m, const peri__array *array) {
    return array->place == offsetof(peri__model, back) && m->back == m->weight ? NULL : peri__pointer_at(m, array->place);
}

static void peri__list_model(const peri_body *b, const peri__model *m, peri__array *list) {
    const int64_t n = m->points, bonds = m->entries, groups = m->stencil.groups, pairs = (int64_t)m->materials * m->materials;
    const size_t real = peri__real(b), bond_real = peri__bond_real(b);
#define PERI_ARRAY_(member, number, bytes, purpose) { #member, offsetof(peri__model, member), number, bytes, 1, purpose, PERI__SCENE }
    const peri__array arrays[PERI_MODEL_ARRAYS] = {
        PERI_ARRAY_(order, n, sizeof(int32_t), PERI__FAMILIES),
        PERI_ARRAY_(start, n, sizeof(int64_t), PERI__FAMILIES),
        PERI_ARRAY_(ids, bonds, sizeof(int32_t), PERI__FAMILIES),
        PERI_ARRAY_(back, bonds, bond_real, PERI__FAMILIES),
        PERI_ARRAY_(weight, bonds, bond_real, PERI__FAMILIES),
        PERI_ARRAY_(bond, bonds, bond_real, PERI__FAMILIES),
        PERI_ARRAY_(centroid, bonds * m->dim, bond_real, PERI__FAMILIES),
        PERI_ARRAY_(partial_volume, bonds, sizeof(float), PERI__FAMILIES),
        PERI_ARRAY_(stencil.begin, groups + 1, sizeof(int64_t), PERI__FAMILIES),
        PERI_ARRAY_(stencil.first, groups, sizeof(int64_t), PERI__FAMILIES),
        PERI_ARRAY_(stencil.column, m->stencil.kept, sizeof(peri__column), PERI__FAMILIES),
        PERI_ARRAY_(stencil.table, m->stencil.vectors, sizeof(peri__stencil_bond), PERI__FAMILIES),
        PERI_ARRAY_(stencil.ends, m->stencil.vectors, sizeof(peri__stencil_ends), PERI__FAMILIES),
        PERI_ARRAY_(x, m->stride * m->dim, real, PERI__POINTS),
        PERI_ARRAY_(volume, n, sizeof(double), PERI__POINTS),
        PERI_ARRAY_(portion, m->stride, real, PERI__POINTS),
        PERI_ARRAY_(material, n, 1, PERI__POINTS),
        PERI_ARRAY_(count, n, sizeof(int32_t), PERI__POINTS),
        PERI_ARRAY_(pieces, m->piece_count, sizeof(peri__piece), PERI__POINTS),
        PERI_ARRAY_(pairs, pairs, sizeof(peri__pair), PERI__LAWS),
        PERI_ARRAY_(law_of, pairs, 1, PERI__LAWS),
        PERI_ARRAY_(part, m->part_bytes, 1, PERI__POINTS),
    };
#undef PERI_ARRAY_
    memcpy(list, arrays, sizeof arrays);
}

/* Frees the first `count` arrays of a model. */
static void peri__free_model_arrays(const peri_body *b, peri__model *m, int count) {
    peri__array arrays[PERI_MODEL_ARRAYS];
    peri__list_model(b, m, arrays);
    for (int k = 0; k < count; ++k) {
        peri__delete(&m->memory, peri__model_array(m, &arrays[k]), arrays[k].count, arrays[k].size);
        peri__set_pointer_at(m, arrays[k].place, NULL);
    }
}

static void *peri__array_of(const peri_body *b, const peri__array *array) { return peri__pointer_at(b, array->place); }

static void peri__set_array(peri_body *b, const peri__array *array, void *pointer) { peri__set_pointer_at(b, array->place, pointer); }

static void peri__list_arrays(const peri_body *b, peri__array *list) {
    const peri__model *m = b->model;
    const int64_t n = m->points, vector = m->stride * m->dim, flags = n * m->words, bonds = peri__bond_slots(m);
    const int64_t constants = peri__constant_planes(m);
    const int32_t states = !m->pairwise, breaks = !m->pairwise && m->breakable;
    const int32_t flows = m->inelastic & PERI__FLOWS;
    const size_t real = peri__real(b), bond = peri__bond_real(b);
#define PERI_ARRAY_(member, number, bytes, want, purpose, role) { #member, offsetof(peri_body, member), number, bytes, want, purpose, role }
    const peri__array arrays[PERI_ARRAYS] = {
        PERI_ARRAY_(records, n * m->record_reals, real, m->record_reals > 0, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(alive, flags, sizeof(uint32_t), 0, PERI__DAMAGE, PERI__BONDS_LEFT),
        PERI_ARRAY_(masks, m->stencil.columns, sizeof(uint16_t), 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(uncut, flags, sizeof(uint32_t), 0, PERI__DAMAGE, PERI__BONDS_LEFT),
        PERI_ARRAY_(before, flags, sizeof(uint32_t), 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(no_fail, n, 1, 0, PERI__DAMAGE, PERI__SCENE),
        PERI_ARRAY_(point_class, n, 1, 0, PERI__LAWS, PERI__SCENE),
        PERI_ARRAY_(pairs, 4 * (int64_t)m->materials * m->materials, sizeof(peri__pair), 1, PERI__LAWS, PERI__SCENE),
        PERI_ARRAY_(sums, m->blocks, sizeof(peri__sums), 1, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(push, vector, sizeof(double), 0, PERI__LOADS, PERI__HISTORY),
        PERI_ARRAY_(constant, constants * m->stride + 2 * m->margin, bond, states, PERI__LAWS, PERI__FOLLOWS),
        PERI_ARRAY_(response, peri__response_reals(m), bond, states, PERI__LAWS, PERI__FOLLOWS),
        PERI_ARRAY_(change_u, peri__vector_reals(m), real, 0, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(change_f, peri__vector_reals(m), real, 0, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(change_response, peri__response_reals(m), bond, 0, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(row_sum, n, sizeof(double), states, PERI__LAWS, PERI__FOLLOWS),
        PERI_ARRAY_(gather_row_sum, n, sizeof(double), states, PERI__LAWS, PERI__FOLLOWS),
        PERI_ARRAY_(central, n / peri__central_of(m) + 1, 1, (m->gathers & PERI__GRADIENT) != 0, PERI__LAWS, PERI__FOLLOWS),
        PERI_ARRAY_(dying, flags, sizeof(uint32_t), breaks, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(near_dying, n, sizeof(int32_t), breaks, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(marked, n, 1, breaks, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(closing, vector, real, m->breakable && (m->inelastic || b->desc.break_timing == PERI_BREAK_WITHIN_STEP), PERI__DAMAGE,
                    PERI__RESTING),
        PERI_ARRAY_(work, bonds, real, (m->seen_by & PERI__BY_WORK) != 0, PERI__DAMAGE, PERI__HISTORY),
        PERI_ARRAY_(pull, bonds * m->dim, real, (m->seen_by & PERI__BY_WORK) != 0, PERI__DAMAGE, PERI__HISTORY),
        PERI_ARRAY_(worked, peri__vector_reals(m), real, (m->seen_by & PERI__BY_WORK) != 0, PERI__DAMAGE, PERI__HISTORY),
        PERI_ARRAY_(history, bonds * m->bond_states, sizeof(double), m->bond_states > 0, PERI__DAMAGE, PERI__HISTORY),
        PERI_ARRAY_(node, n, sizeof(double), (m->seen_by & PERI__BY_NODE_ENERGY) != 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(eigenstrain, m->stride + 2 * m->margin, bond, 0, PERI__LAWS, PERI__FIELD),
        PERI_ARRAY_(strength, m->stride + 2 * m->margin, bond, 0, PERI__DAMAGE, PERI__FIELD),
        PERI_ARRAY_(bond_strength, bonds, sizeof(float), 0, PERI__DAMAGE, PERI__FIELD),
        PERI_ARRAY_(stiffness, m->stride + 2 * m->margin, bond, 0, PERI__LAWS, PERI__FIELD),
        PERI_ARRAY_(density, n, sizeof(double), 0, PERI__POINTS, PERI__FIELD),
        PERI_ARRAY_(stress, n * m->dim * m->dim, sizeof(double), (m->seen_by & PERI__BY_STRESS) != 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(nearness, n, sizeof(double), (m->seen_by & PERI__BY_STRESS) != 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(aligned, n * PERI_ALIGNED, sizeof(double), (m->seen_by & PERI__BY_STRESS) != 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(inverse, n * (PERI_PACKED(m->dim) + 1), sizeof(double), (m->seen_by & PERI__BY_STRESS) != 0, PERI__DAMAGE,
                    PERI__SCRATCH),
        PERI_ARRAY_(inverse_alive, flags, sizeof(uint32_t), (m->seen_by & PERI__BY_STRESS) != 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(least, n, sizeof(double), (m->seen_by & PERI__AND_LEAST) != 0, PERI__DAMAGE, PERI__SCRATCH),
        PERI_ARRAY_(overtime, bonds, sizeof(double), (m->seen_by & PERI__AND_PAST) != 0, PERI__DAMAGE, PERI__HISTORY),
        PERI_ARRAY_(past.start, n + 1, sizeof(int64_t), flows, PERI__LAWS, PERI__SCENE),
        PERI_ARRAY_(past.mirror, m->bonds, sizeof(int32_t), flows, PERI__LAWS, PERI__SCENE),
        PERI_ARRAY_(past.flow, m->bonds, sizeof(double), flows, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(past.change, m->bonds, sizeof(double), flows, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(past.bond, m->bonds * m->past.bond, sizeof(double), flows, PERI__STATE, PERI__HISTORY),
        PERI_ARRAY_(past.point, n * m->past.point, sizeof(double), m->past.point > 0, PERI__STATE, PERI__HISTORY),
        PERI_ARRAY_(past.trial, n * m->past.point, sizeof(double), m->past.point > 0, PERI__STATE, PERI__SCRATCH),
        PERI_ARRAY_(side_start, n + 1, sizeof(int64_t), 0, PERI__DAMAGE, PERI__SCENE),
        PERI_ARRAY_(side, b->side_count, sizeof(int32_t), 0, PERI__DAMAGE, PERI__SCENE),
        PERI_ARRAY_(side_time, b->side_count, sizeof(double), 0, PERI__DAMAGE, PERI__HISTORY),
        PERI_ARRAY_(fragment_alive, flags, sizeof(uint32_t), 0, PERI__FIELDS, PERI__SCRATCH),
        PERI_ARRAY_(fragment_of, n, sizeof(int32_t), 0, PERI__FIELDS, PERI__SCRATCH),
        PERI_ARRAY_(fragments, n, sizeof(peri__fragment), 0, PERI__FIELDS, PERI__SCRATCH),
    };
#undef PERI_ARRAY_
    memcpy(list, arrays, sizeof arrays);
}

/* Sets to 0 what is so between steps; and the history. */
static void peri__clear_arrays(peri_body *b, int history) {
    peri__array arrays[PERI_ARRAYS];
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS; ++k) {
        void *array = peri__array_of(b, &arrays[k]);
        if (array && (arrays[k].role == PERI__RESTING || (history && arrays[k].role == PERI__HISTORY)))
            memset(array, 0, (size_t)arrays[k].count * arrays[k].size);
    }
}

/* Takes what the scene has use for. 0 where memory is short. */
static int peri__need_arrays(peri_body *b) {
    peri__array arrays[PERI_ARRAYS];
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS; ++k) {
        void *made;
        if (!arrays[k].wanted) continue;
        made = peri__new(&b->memory, arrays[k].count, arrays[k].size);
        if (!made) return 0;
        peri__set_array(b, &arrays[k], made);
    }
    return 1;
}

/* ---- what it comes to --------------------------------------------------------------------------------------------- */

static int64_t peri__held_bytes(const void *pointer, int64_t count, size_t size) {
    return pointer ? (int64_t)peri__block_bytes(count, size) : 0;
}

/* Adds what the model holds, by purpose. */
static void peri__count_model(const peri_body *b, const peri__model *m, int64_t *held) {
    peri__array arrays[PERI_MODEL_ARRAYS];
    peri__list_model(b, m, arrays);
    for (int k = 0; k < PERI_MODEL_ARRAYS; ++k)
        held[arrays[k].purpose] += peri__held_bytes(peri__model_array(m, &arrays[k]), arrays[k].count, arrays[k].size);
    held[PERI__LAWS] += peri__held_bytes(m, 1, sizeof *m);
}

static void peri__count_setup(const peri_body *b, int64_t *held) {
    const peri__setup *s = &b->setup;
    int64_t points = peri__held_bytes(s->pieces, s->piece_capacity, sizeof *s->pieces);
    points += peri__held_bytes(s->local, s->point_capacity * b->dim, sizeof *s->local);
    points += peri__held_bytes(s->volume, s->point_capacity, sizeof *s->volume);
    points += peri__held_bytes(s->material, s->point_capacity, sizeof *s->material);
    for (int64_t k = 0; k < s->piece_count; ++k) {
        const peri__cells *shapes = s->pieces[k].shapes;
        points += peri__held_bytes(s->pieces[k].vertices, s->pieces[k].vertex_bytes, 1);
        points += peri__held_bytes(shapes, shapes ? shapes->bytes : 0, 1);
    }
    points += peri__held_bytes(s->part, s->part ? s->part->bytes : 0, 1);
    held[PERI__POINTS] += points;
    held[PERI__FAMILIES] += peri__held_bytes(s->ibond, s->ibond_entries, sizeof *s->ibond);
}

/* Adds what the body holds beside its model. */
static void peri__count_body(const peri_body *b, int64_t *held) {
    const peri__model *m = b->model;
    held[PERI__LAWS] += peri__held_bytes(b, 1, sizeof *b);
    held[PERI__LAWS] += peri__held_bytes(b->interfaces, b->interface_capacity, sizeof *b->interfaces);
    held[PERI__LAWS] += peri__held_bytes(b->bond_laws, b->bond_law_capacity, sizeof *b->bond_laws);
    peri__count_setup(b, held);
    if (!m) return;
    peri__array arrays[PERI_ARRAYS];
    const void *vectors[3] = { b->u, b->v, b->f };
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS; ++k)
        held[arrays[k].purpose] += peri__held_bytes(peri__array_of(b, &arrays[k]), arrays[k].count, arrays[k].size);
    for (int k = 0; k < 3; ++k) held[PERI__STATE] += peri__held_bytes(vectors[k], peri__vector_reals(m), peri__real(b));
    for (const peri__taken *taken = b->keeping; taken; taken = taken->next) held[PERI__STATE] += (int64_t)taken->bytes;
    for (int k = 0; k < peri__count_field; ++k)
        held[PERI__FIELDS] += peri__held_bytes(b->derived[k].data, m->points * b->derived[k].components, sizeof(double));
    int64_t loads = peri__held_bytes(b->sets, b->set_capacity, sizeof *b->sets);
    loads += peri__held_bytes(b->loads, b->load_capacity, sizeof *b->loads);
    loads += peri__held_bytes(b->obstacles, b->obstacle_capacity, sizeof *b->obstacles);
    for (int64_t k = 0; k < b->obstacle_count; ++k) {
        const peri__obstacle *o = &b->obstacles[k];
        loads += peri__held_bytes(o->solid.mesh, o->solid.mesh ? o->solid.mesh->bytes : 0, 1);
        loads += peri__held_bytes(o->free, 1, sizeof *o->free);
        loads += peri__held_bytes(o->kept, m->points * PERI_KEPT, sizeof *o->kept);
        loads += peri__held_bytes(o->tally, m->blocks * PERI_TALLIED, sizeof *o->tally);
    }
    for (int64_t k = 0; k < b->set_count; ++k) {
        loads += peri__held_bytes(b->sets[k].name, b->sets[k].name_bytes, 1);
        loads += peri__held_bytes(b->sets[k].points, b->sets[k].all, sizeof *b->sets[k].points);
    }
    for (int64_t k = 0; k < b->load_count; ++k) {
        const peri__load *load = &b->loads[k];
        const int64_t reals = load->count * b->dim;
        loads += peri__held_bytes(load->value, reals, sizeof *load->value);
        loads += peri__held_bytes(load->force, PERI__SUPPORT_PLANES * reals, sizeof *load->force);
        loads += peri__held_bytes(load->spread, reals * b->dim, sizeof *load->spread);
        loads += peri__held_bytes(load->owned, load->count, sizeof *load->owned);
        loads += peri__held_bytes(load->all, load->count, sizeof *load->all);
    }
    held[PERI__LOADS] += loads + peri__contact_bytes(b);
}

static int64_t peri__held_total(const int64_t *held) {
    int64_t total = 0;
    for (int k = 0; k < PERI__PURPOSES; ++k) total += held[k];
    return total;
}

PERI_API int32_t peri_get_memory(const peri_body *b, peri_memory *memory) {
    int64_t held[PERI__PURPOSES] = { 0 };
    PERI_NEED_BODY(b);
    if (!memory) return peri__fail_const(b, PERI_ERROR_ARGUMENT, "memory", -1, 0.0);
    if (b->model) peri__count_model(b, b->model, held);
    memory->shared = peri__held_total(held);
    peri__count_body(b, held);
    memory->points = held[PERI__POINTS];
    memory->families = held[PERI__FAMILIES];
    memory->damage = held[PERI__DAMAGE];
    memory->state = held[PERI__STATE];
    memory->laws = held[PERI__LAWS];
    memory->loads = held[PERI__LOADS];
    memory->fields = held[PERI__FIELDS];
    memory->total = peri__held_total(held);
    return PERI_OK;
}
