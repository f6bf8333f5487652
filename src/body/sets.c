/* SPDX-License-Identifier: MIT */
/* sets.c - named selections of points. Inside they are numbered from 1; 0 is PERI_ALL, which is stored nowhere. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Component d of point i, user's units: reference position. */
static double peri__position(const peri_body *b, int64_t i, int32_t d) {
    const peri__model *m = b->model;
    return m->origin[d] + m->length * peri__get_real(m->x, b->f32, d * m->stride + i);
}

/* And the displacement of where it is. */
static double peri__moved(const peri_body *b, int64_t i, int32_t d) {
    return b->model->length * peri__get_real(b->u, b->f32, d * b->model->stride + i);
}

/* Nearer than this touches; inner units. Single precision moves points by the rounding of their coordinates. */
static double peri__touching(const peri_body *b) {
    const peri__model *m = b->model;
    return PERI_TOUCH * m->spacing + (b->f32 ? 0.5 * (double)FLT_EPSILON * m->extent : 0.0);
}

static int64_t peri__set_count(const peri_body *b, int32_t set) {
    if (set == 0) return b->model->points - (b->model->part ? b->model->part->desc.ghost_count : 0);
    return b->sets[set - 1].count;
}

static int32_t peri__set_point(const peri_body *b, int32_t set, int64_t k) {
    if (set == 0) return b->model->part ? b->model->part->owned[k] : (int32_t)k;
    return b->sets[set - 1].points[k];
}

/* With its ghosts, which come after the points that are owned. */
static int64_t peri__set_all(const peri_body *b, int32_t set) { return set == 0 ? b->model->points : b->sets[set - 1].all; }

static int32_t peri__set_any(const peri_body *b, int32_t set, int64_t k) { return set == 0 ? (int32_t)k : b->sets[set - 1].points[k]; }

/* What a set is called inside, 0 for all; or why its id is none. */
static int32_t peri__find_set(peri_body *b, int32_t id) {
    if (id == PERI_ALL) return 0;
    const int64_t index = peri__find(b, PERI_KIND_SET, id, "set");
    return (int32_t)(index < 0 ? index : index + 1);
}

/* The id of the set with a name, 0 where there is none. */
static int32_t peri__set_named(const peri_body *b, const char *name) {
    for (int64_t k = 0; k < b->set_count; ++k)
        if (b->sets[k].name && strcmp(b->sets[k].name, name) == 0) return peri__id(b, PERI_KIND_SET, k);
    return 0;
}

PERI_API int32_t peri_find_set(const peri_body *b, const char *name) {
    PERI_NEED_BODY(b);
    if (!name) return peri__fail_const(b, PERI_ERROR_ARGUMENT, "name", -1, 0.0);
    const int32_t set = peri__set_named(b, name);
    return set ? set : peri__fail_const(b, PERI_ERROR_NAME, "name", -1, 0.0);
}

/* Moves the ghosts of points[count] to the end, all ascending as before; returns how many are none. */
static int64_t peri__part_set(const peri_body *b, const int32_t *points, int64_t count, int32_t *out) {
    int64_t owned = 0, ghosts = 0;
    for (int64_t k = 0; k < count; ++k)
        if (!peri__is_ghost(b->model, points[k])) out[owned++] = points[k];
    for (int64_t k = 0; k < count; ++k)
        if (peri__is_ghost(b->model, points[k])) out[owned + ghosts++] = points[k];
    return owned;
}

/* Takes over points[capacity] of b->scratch, of which the first count are the set (ascending). A part may have none of it. */
static int32_t peri__new_set(peri_body *b, const char *name, int32_t *points, int64_t capacity, int64_t count) {
    peri__set set;
    int32_t status = PERI_OK;
    memset(&set, 0, sizeof set);
    if (count == 0 && !b->model->part) status = peri__fail(b, PERI_ERROR_EMPTY, "set", -1, 0.0);
    else if (name && peri__set_named(b, name)) status = peri__fail(b, PERI_ERROR_NAME, "name", peri__set_named(b, name), 0.0);
    else status = peri__check_room(b, PERI_KIND_SET, PERI_ID_LIMIT, "set");
    if (status == PERI_OK && !peri__grow(&b->memory, &b->sets, &b->set_capacity, b->set_count + 1, sizeof *b->sets))
        status = peri__fail(b, PERI_ERROR_MEMORY, "set", -1, 0.0);
    if (status == PERI_OK) {
        set.points = (int32_t *)peri__copy(&b->memory, points, count, sizeof *points);
        set.count = set.all = count;
        if (b->model->part && set.points) set.count = peri__part_set(b, points, count, set.points);
        if (name) {
            set.name_bytes = (int64_t)strlen(name) + 1;
            set.name = (char *)peri__copy(&b->memory, name, set.name_bytes, 1);
        }
        if (!set.points || (name && !set.name)) {
            peri__delete(&b->memory, set.points, count, sizeof *points);
            peri__delete(&b->memory, set.name, set.name_bytes, 1);
            status = peri__fail(b, PERI_ERROR_MEMORY, "set", -1, 0.0);
        }
    }
    peri__delete(&b->scratch, points, capacity, sizeof *points);
    if (status < 0) return status;
    b->sets[b->set_count++] = set;
    return peri__id(b, PERI_KIND_SET, b->set_count - 1);
}

/* By reference positions; in_place: by present ones. */
static int32_t peri__select(peri_body *b, const char *name, int in_place, peri_point_fn take, void *user) {
    const peri__model *m = b->model;
    int32_t *points = (int32_t *)peri__new(&b->scratch, m->points, sizeof *points);
    int64_t count = 0;
    if (!points) return peri__fail(b, PERI_ERROR_MEMORY, "set", -1, 0.0);
    int32_t said = 0;
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    for (int64_t i = 0; i < m->points && said >= 0; ++i) {
        double x[3];
        for (int32_t d = 0; d < m->dim; ++d) x[d] = peri__position(b, i, d) + (in_place ? peri__moved(b, i, d) : 0.0);
        said = take(user, i, x);
        if (said > 0) points[count++] = (int32_t)i;
    }
    peri__leave(b, former);
    if (said < 0) {
        peri__delete(&b->scratch, points, m->points, sizeof *points);
        return peri__fail(b, PERI_ERROR_CALLBACK, "peri_point_fn", -1, said);
    }
    return peri__new_set(b, name, points, m->points, count);
}

typedef struct peri__inside_box {
    double  lo[3], hi[3];
    int32_t dim;
} peri__inside_box;

static int32_t peri__is_inside_box(void *user, int64_t index, const double *x) {
    const peri__inside_box *box = (const peri__inside_box *)user;
    (void)index;
    for (int32_t d = 0; d < box->dim; ++d)
        if (!(x[d] >= box->lo[d] && x[d] <= box->hi[d])) return 0;
    return 1;
}

static int32_t peri__select_box(peri_body *b, const char *name, int in_place, const double *lo, const double *hi) {
    peri__inside_box box;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_VECTOR(b, lo);
    PERI_NEED_VECTOR(b, hi);
    double touch = peri__touching(b) * b->model->length;
    box.dim = b->dim;
    for (int32_t d = 0; d < b->dim; ++d) {
        box.lo[d] = lo[d] - touch;
        box.hi[d] = hi[d] + touch;
    }
    return peri__select(b, name, in_place, peri__is_inside_box, &box);
}

PERI_API int32_t peri_select_box(peri_body *b, const char *name, const double *lo, const double *hi) {
    return peri__select_box(b, name, 0, lo, hi);
}

PERI_API int32_t peri_select_box_in_place(peri_body *b, const char *name, const double *lo, const double *hi) {
    return peri__select_box(b, name, 1, lo, hi);
}

static int32_t peri__select_ball(peri_body *b, const char *name, int in_place, const double *centre, double radius) {
    peri__within ball;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_VECTOR(b, centre);
    PERI_NEED_NUMBER(b, radius > 0.0, radius);
    ball.centre = centre;
    ball.radius = radius + peri__touching(b) * b->model->length;
    ball.dim = b->dim;
    return peri__select(b, name, in_place, peri__is_within, &ball);
}

PERI_API int32_t peri_select_ball(peri_body *b, const char *name, const double *centre, double radius) {
    return peri__select_ball(b, name, 0, centre, radius);
}

PERI_API int32_t peri_select_ball_in_place(peri_body *b, const char *name, const double *centre, double radius) {
    return peri__select_ball(b, name, 1, centre, radius);
}

/* The point nearest to x, of equally near ones the least. */
static int32_t peri__find_point(peri_body *b, int in_place, const double *x) {
    int64_t nearest = 0;
    double least = HUGE_VAL;
    PERI_NEED_BUILT(b);
    PERI_NEED_VECTOR(b, x);
    for (int64_t i = 0; i < b->model->points; ++i) {
        double square = 0.0; /* in spacings, so that no unit is too small or too large for it */
        for (int32_t d = 0; d < b->dim; ++d) {
            const double from = x[d] - peri__position(b, i, d) - (in_place ? peri__moved(b, i, d) : 0.0);
            square += peri__square(from / b->model->length);
        }
        if (square < least) {
            least = square;
            nearest = i;
        }
    }
    return (int32_t)nearest;
}

PERI_API int32_t peri_find_point(peri_body *b, const double *x) { return peri__find_point(b, 0, x); }

PERI_API int32_t peri_find_point_in_place(peri_body *b, const double *x) { return peri__find_point(b, 1, x); }

PERI_API int32_t peri_select_if(peri_body *b, const char *name, peri_point_fn take, void *user) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED(b, take, "take");
    return peri__select(b, name, 0, take, user);
}

PERI_API int32_t peri_select_points(peri_body *b, const char *name, int64_t count, const int32_t *points) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED(b, points && count >= 0, "points");
    const peri__model *m = b->model;
    for (int64_t k = 0; k < count; ++k)
        if (points[k] < 0 || points[k] >= m->points) return peri__fail(b, PERI_ERROR_INDEX, "points", k, points[k]);
    /* mark, then collect: ascending, and each once */
    uint8_t *marked = (uint8_t *)peri__new(&b->memory, m->points, 1);
    int32_t *ids = (int32_t *)peri__new(&b->scratch, m->points, sizeof *ids);
    int64_t kept = 0;
    if (!marked || !ids) {
        peri__delete(&b->memory, marked, m->points, 1);
        peri__delete(&b->scratch, ids, m->points, sizeof *ids);
        return peri__fail(b, PERI_ERROR_MEMORY, "set", -1, 0.0);
    }
    for (int64_t k = 0; k < count; ++k) marked[points[k]] = 1;
    for (int64_t i = 0; i < m->points; ++i)
        if (marked[i]) ids[kept++] = (int32_t)i;
    peri__delete(&b->memory, marked, m->points, 1);
    return peri__new_set(b, name, ids, m->points, kept);
}

PERI_API int64_t peri_size_of_set(const peri_body *b, int32_t set) {
    PERI_NEED_BODY(b);
    if (!b->model) return peri__fail_const(b, PERI_ERROR_ORDER, "peri_build", -1, 0.0);
    const int32_t at = peri__find_set((peri_body *)b, set);
    return at < 0 ? at : peri__set_count(b, at);
}

PERI_API int32_t peri_get_set(peri_body *b, int32_t id, int32_t *points, int64_t capacity) {
    PERI_NEED_BUILT(b);
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    PERI_NEED(b, points, "points");
    int64_t count = peri__set_count(b, set);
    if (capacity < count) return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)count);
    for (int64_t k = 0; k < count; ++k) points[k] = peri__set_point(b, set, k);
    return PERI_OK;
}
