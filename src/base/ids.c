/* SPDX-License-Identifier: MIT */
/* ids.c - ids of what a body holds: kind << 27 | number of the body << 20 | 1, 2, ... in the order in which they were given.
   So an id is positive, no id of one kind is one of another, and ids of two bodies differ where their numbers do. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_ID_KIND(id)   ((int32_t)((id) >> 27))
#define PERI_ID_NUMBER(id) ((int32_t)((id) >> 20 & 0x7F))
#define PERI_ID_LIMIT      0xFFFFF /* of one kind                                                                          */

/* The id of the thing of a kind at `index` (0, 1, ...) of its array. */
static int32_t peri__id(const peri_body *b, int32_t kind, int64_t index) {
    const int64_t tag = (int64_t)(kind - peri__first_kind + 1) << 27 | (int64_t)b->number << 20;
    return (int32_t)(tag | (index + 1));
}

static int64_t peri__count_of(const peri_body *b, int32_t kind) {
    switch (kind) {
    case PERI_KIND_MATERIAL: return b->material_count;
    case PERI_KIND_SET: return b->set_count;
    case PERI_KIND_LOAD: return b->load_count;
    default: return b->obstacle_count;
    }
}

/* One more of a kind would have no id; nor does `most` allow more. */
static int32_t peri__check_room(peri_body *b, int32_t kind, int64_t most, const char *field) {
    most = peri__min(most, PERI_ID_LIMIT);
    return peri__count_of(b, kind) < most ? PERI_OK : peri__fail(b, PERI_ERROR_TOO_LARGE, field, -1, (double)most);
}

/* Of materials and sets there is nothing to remove. */
static int peri__is_removed(const peri_body *b, int32_t kind, int64_t index) {
    return (kind == PERI_KIND_LOAD && b->loads[index].kind == PERI__FREE)
        || (kind == PERI_KIND_OBSTACLE && b->obstacles[index].kind == PERI__REMOVED);
}

/* Where in the array of its kind a thing is, or why the id is none: `field` is the argument that holds it. */
static int64_t peri__find(peri_body *b, int32_t kind, int32_t id, const char *field) {
    const int64_t index = (int64_t)PERI_ID_INDEX(id) - 1;
    int32_t status = PERI_OK;
    if (id < 1 << 27) status = PERI_ERROR_ID_NONE;
    else if (PERI_ID_KIND(id) != kind - peri__first_kind + 1) status = PERI_ERROR_ID_KIND;
    else if (PERI_ID_NUMBER(id) != b->number) status = PERI_ERROR_ID_BODY;
    else if (index < 0 || index >= peri__count_of(b, kind) || peri__is_removed(b, kind, index)) status = PERI_ERROR_ID_GONE;
    return status == PERI_OK ? index : peri__fail(b, status, field, id, 0.0);
}

/* The number of a body that was given none: from where it lies, so that bodies that live at the same time mostly differ. */
static int32_t peri__number_of(const peri_body *b) {
    return 1 + (int32_t)((((uint64_t)(uintptr_t)b >> 4) * 0x9E3779B97F4A7C15u >> 32) % 127);
}

PERI_API int32_t peri_id(const peri_body *b, int32_t kind, int64_t index) {
    if (!b) return PERI_ERROR_ARGUMENT;
    if (!PERI_IS_ONE_OF(kind, kind)) return peri__fail_const(b, PERI_ERROR_CHOICE, "kind", -1, kind);
    if (index < 1 || index > peri__count_of(b, kind)) return peri__fail_const(b, PERI_ERROR_ID_GONE, "index", index, 0.0);
    return peri__id(b, kind, index - 1);
}
