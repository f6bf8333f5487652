/* arrays.c - what a body keeps per point and per bond: which arrays there are, how large, and which of them a scene needs. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Numbers per point of a field, 0 where there is no such field. */
static int32_t peri__components(int32_t field, int32_t dim) {
    switch (field) {
    case PERI_POSITION: case PERI_DISPLACEMENT: case PERI_VELOCITY: case PERI_FORCE_DENSITY: case PERI_CURRENT: case PERI_REACTION:
        return dim;
    case PERI_STRAIN: case PERI_STRESS: case PERI_FORCE_STRESS: return PERI_PACKED(dim);
    default: return field >= 1 && field <= PERI_FIELDS;
    }
}

/* The arrays of a body that are taken where a scene has use for them: where the pointer is, how much it points to, and whether
   peri_build takes it. */
typedef struct peri__array {
    size_t  place; /* in peri_body                                                                                       */
    int64_t count;
    size_t  size;
    int     wanted;
} peri__array;
#define PERI_ARRAYS 22

static void *peri__array_of(const peri_body *b, const peri__array *array) {
    void *pointer;
    memcpy(&pointer, (const char *)b + array->place, sizeof pointer);
    return pointer;
}

static void peri__set_array(peri_body *b, const peri__array *array, void *pointer) {
    memcpy((char *)b + array->place, &pointer, sizeof pointer);
}

static void peri__list_arrays(const peri_body *b, peri__array *list) {
    const peri__model *m = b->model;
    const int64_t n = m->points, vector = m->stride * m->dim, flags = n * m->words, bonds = m->entries;
    const int64_t constants = m->tensors ? PERI__INVERSE + PERI_PACKED(m->dim) : PERI__VECTOR;
    const int32_t states = m->states, breaks = m->states && m->breakable;
    const size_t real = peri__real(b), bond = peri__bond_real(b);
#define PERI_ARRAY_(member, number, bytes, want) { offsetof(peri_body, member), number, bytes, want }
    const peri__array arrays[PERI_ARRAYS] = {
        PERI_ARRAY_(pack, n * m->slots, real, m->slots > 0),
        PERI_ARRAY_(alive, flags, sizeof(uint32_t), 0),
        PERI_ARRAY_(lanes_alive, m->lanes.columns, sizeof(uint16_t), 0),
        PERI_ARRAY_(uncut, flags, sizeof(uint32_t), 0),
        PERI_ARRAY_(before, flags, sizeof(uint32_t), 0),
        PERI_ARRAY_(no_fail, n, 1, 0),
        PERI_ARRAY_(cls, n, 1, 0),
        PERI_ARRAY_(pairs, 4 * (int64_t)m->materials * m->materials, sizeof(peri__pair), 0),
        PERI_ARRAY_(sums, m->blocks, sizeof(peri__sums), 0),
        PERI_ARRAY_(push, vector, sizeof(double), 0),
        PERI_ARRAY_(constant, constants * m->stride + 2 * m->margin, bond, states),
        PERI_ARRAY_(response, (m->tensors ? 1 + m->dim * m->dim : 1) * m->stride + 2 * m->margin, bond, states),
        PERI_ARRAY_(rate, n, sizeof(double), states),
        PERI_ARRAY_(wide, n, sizeof(double), states),
        PERI_ARRAY_(central, n / PERI_LANES + 1, 1, m->tensors),
        PERI_ARRAY_(dying, flags, sizeof(uint32_t), breaks),
        PERI_ARRAY_(near_dying, n, sizeof(int32_t), breaks),
        PERI_ARRAY_(marked, n, 1, breaks),
        PERI_ARRAY_(work, bonds, real, m->works),
        PERI_ARRAY_(pull, bonds * m->dim, real, m->works),
        PERI_ARRAY_(worked, vector, real, m->works),
        PERI_ARRAY_(node, n, sizeof(double), m->nodes),
    };
#undef PERI_ARRAY_
    memcpy(list, arrays, sizeof arrays);
}

/* What state-based laws keep per point, and their criteria per bond: as much as the scene has use for. 0 where memory is short. */
static int peri__need_states(peri_body *b) {
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
