/* SPDX-License-Identifier: MIT */
/* obstacle_desc.c - obstacles, as the caller adds and removes them, reads and sets their state. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_OBSTACLE (UINT64_C(0x7065726900260000) + sizeof(peri_obstacle_desc))

PERI_API void peri_obstacle_desc_init(peri_obstacle_desc *d, int32_t shape) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_OBSTACLE;
    d->shape = shape;
    d->restitution = 1.0;
}

/* ---- checks ----------------------------------------------------------------------------------------------------- */

#define PERI_NEED_NUMBERS(b, numbers, count)                                                                           \
    if (!peri__finite_vector(numbers, count))                                                                          \
        return peri__fail(b, PERI_ERROR_RANGE, peri__field_name(#numbers), -1, peri__not_finite(numbers, count))

/* Lengths of an obstacle, inner units: beyond 1e15 spacings its surface is lost in rounding. */
#define PERI_NEED_LENGTH(b, number)                                                                                    \
    PERI_NEED_NUMBER(b, (number) > 0.0 && (number) / (b)->model->length < 1e15, number)

static int32_t peri__check_surface(peri_body *b, const peri_obstacle_desc *d) {
    PERI_NEED_NUMBER(b, d->stiffness >= 0.0, d->stiffness);
    PERI_NEED_NUMBER(b, d->friction >= 0.0 && d->friction < 1e6, d->friction);
    PERI_NEED_NUMBER(b, d->friction_speed >= 0.0, d->friction_speed);
    PERI_NEED_NUMBER(b, d->restitution > 0.0 && d->restitution <= 1.0, d->restitution);
    return PERI_OK;
}

static int32_t peri__check_motion(peri_body *b, const peri_obstacle_desc *d) {
    const int32_t turns = b->dim == 2 ? 1 : 3;
    const double speed = peri__velocity_unit(b->model);
    PERI_NEED_NUMBER(b, d->mass >= 0.0, d->mass);
    PERI_NEED_NUMBER(b, d->density >= 0.0, d->density);
    if (d->mass == 0.0 && d->density == 0.0) return PERI_OK;
    PERI_NEED(b, d->mass == 0.0 || d->density == 0.0, "density");
    PERI_NEED(b, !d->motion, "motion");
    for (int32_t k = 0; k < turns; ++k)
        if (!(d->inertia[k] >= 0.0) || (d->inertia[k] > 0.0) != (d->inertia[0] > 0.0))
            return peri__fail(b, PERI_ERROR_RANGE, "inertia", -1, d->inertia[k]);
    PERI_NEED_NUMBERS(b, d->velocity, b->dim);
    PERI_NEED_NUMBERS(b, d->spin, turns);
    PERI_NEED_NUMBERS(b, d->gravity, b->dim);
    for (int32_t k = 0; k < b->dim; ++k)
        if (!(fabs(d->velocity[k]) / speed < 1e9)) return peri__fail(b, PERI_ERROR_RANGE, "velocity", -1, d->velocity[k]);
    return PERI_OK;
}

static int32_t peri__check_obstacle(peri_body *b, const peri_obstacle_desc *d) {
    PERI_NEED(b, d, "desc");
    if (d->cookie != PERI_COOKIE_OBSTACLE) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_CHOICE(b, shape, d->shape);
    PERI_NEED_NUMBERS(b, d->place, b->dim);
    PERI_NEED_NUMBERS(b, d->turn, b->dim == 2 ? 1 : 4);
    int32_t status = peri__check_surface(b, d);
    if (status == PERI_OK) status = peri__check_motion(b, d);
    return status;
}

/* ---- shapes ----------------------------------------------------------------------------------------------------- */

static int32_t peri__read_mesh(peri_body *b, const peri_obstacle_desc *d, peri__mesh *mesh) {
    const double unit = b->model->length;
    for (int64_t k = 0; k < mesh->vertices * b->dim; ++k) {
        if (!(fabs(d->vertices[k] / unit) < 1e15)) return peri__fail(b, PERI_ERROR_RANGE, "vertices", k / b->dim, d->vertices[k]);
        mesh->vertex[k / b->dim * 3 + k % b->dim] = d->vertices[k] / unit;
    }
    for (int64_t k = 0; k < mesh->faces * mesh->corners; ++k) {
        const int64_t next = k / 2 + k % 2; /* of a polygon */
        if (b->dim == 3 && !(d->faces[k] >= 0 && d->faces[k] < mesh->vertices))
            return peri__fail(b, PERI_ERROR_RANGE, "faces", k / 3, d->faces[k]);
        mesh->face[k] = b->dim == 3 ? d->faces[k] : (int32_t)(next == mesh->vertices ? 0 : next);
    }
    return PERI_OK;
}

static int32_t peri__complete_mesh(peri_body *b, peri__mesh *mesh, void *room) {
    double centre[3], inertia[9];
    int64_t bad = peri__mesh_normals(mesh);
    if (bad < 0 && b->dim == 3) bad = peri__mesh_edges(mesh, (peri__edge *)room);
    if (bad >= 0) return peri__fail(b, PERI_ERROR_RANGE, b->dim == 3 ? "faces" : "vertices", bad, 0.0);
    const double volume = peri__mesh_bulk(mesh, centre, inertia);
    if (!(volume > 0.0))
        return peri__fail(b, PERI_ERROR_RANGE, b->dim == 3 ? "faces" : "vertices", -1, volume * pow(b->model->length, b->dim));
    peri__grow_tree(mesh, (peri__keyed *)room);
    return PERI_OK;
}

static int32_t peri__make_mesh(peri_body *b, const peri_obstacle_desc *d, peri__mesh **made) {
    PERI_NEED(b, d->vertices, "vertices");
    PERI_NEED(b, d->vertex_count > b->dim && d->vertex_count < INT32_MAX, "vertex_count");
    PERI_NEED(b, b->dim == 2 || d->faces, "faces");
    PERI_NEED(b, b->dim == 2 || (d->face_count > 3 && d->face_count < INT32_MAX / 3), "face_count");
    const int64_t faces = b->dim == 2 ? d->vertex_count : d->face_count, bytes = peri__mesh_bytes(d->vertex_count, faces);
    const size_t item = sizeof(peri__edge) > sizeof(peri__keyed) ? sizeof(peri__edge) : sizeof(peri__keyed);
    peri__mesh *mesh = (peri__mesh *)peri__new(&b->memory, bytes, 1);
    void *room = mesh ? peri__new(&b->scratch, 3 * faces, item) : NULL;
    int32_t status = room ? PERI_OK : peri__fail(b, PERI_ERROR_MEMORY, "vertices", -1, 0.0);
    if (room) {
        mesh->bytes = bytes;
        mesh->vertices = d->vertex_count;
        mesh->faces = faces;
        mesh->corners = b->dim;
        peri__bind_mesh(mesh);
        status = peri__read_mesh(b, d, mesh);
        if (status == PERI_OK) status = peri__complete_mesh(b, mesh, room);
    }
    peri__delete(&b->scratch, room, 3 * faces, item);
    if (status < 0) peri__delete(&b->memory, mesh, bytes, 1);
    else *made = mesh;
    return status;
}

static int32_t peri__read_shape(peri_body *b, const peri_obstacle_desc *d, peri__solid *s) {
    const double unit = b->model->length;
    const int rod = d->shape == PERI_SHAPE_CAPSULE || d->shape == PERI_SHAPE_CYLINDER;
    s->shape = d->shape;
    if (d->shape == PERI_SHAPE_CYLINDER && b->dim == 2) return peri__fail(b, PERI_ERROR_CHOICE, "shape", -1, d->shape);
    if (d->shape == PERI_SHAPE_PLANE) {
        PERI_NEED_NUMBERS(b, d->normal, b->dim);
        if (!peri__direction(d->normal, b->dim, s->direction)) return peri__fail(b, PERI_ERROR_RANGE, "normal", -1, 0.0);
    }
    if (rod || d->shape == PERI_SHAPE_BALL) PERI_NEED_LENGTH(b, d->radius);
    if (rod) {
        PERI_NEED_LENGTH(b, d->length);
        PERI_NEED_NUMBERS(b, d->axis, b->dim);
        if (!peri__direction(d->axis, b->dim, s->direction)) return peri__fail(b, PERI_ERROR_RANGE, "axis", -1, 0.0);
        s->half[0] = 0.5 * d->length / unit;
    }
    for (int32_t k = 0; d->shape == PERI_SHAPE_BOX && k < b->dim; ++k) {
        if (!(d->size[k] > 0.0 && d->size[k] / unit < 1e15)) return peri__fail(b, PERI_ERROR_RANGE, "size", k, d->size[k]);
        s->half[k] = 0.5 * d->size[k] / unit;
    }
    if (d->shape == PERI_SHAPE_DISTANCE) {
        PERI_NEED(b, d->distance, "distance");
        PERI_NEED_NUMBER(b, d->radius >= 0.0, d->radius);
        s->distance = d->distance;
    }
    s->radius = d->shape == PERI_SHAPE_BOX || d->shape == PERI_SHAPE_MESH ? 0.0 : d->radius / unit;
    return d->shape == PERI_SHAPE_MESH ? peri__make_mesh(b, d, &s->mesh) : PERI_OK;
}

/* ---- mass ------------------------------------------------------------------------------------------------------- */

static double peri__mass_unit(const peri__model *m) { return m->energy / peri__square(peri__velocity_unit(m)); }

/* The inverse of the moments of inertia; along what never turns, infinite, both become 0. */
static int32_t peri__set_inertia(peri_body *b, peri__free_body *f) {
    double packed[6], inverse[6];
    if (b->dim == 2) {
        f->inverse[8] = 1.0 / f->inertia[8];
        if (!(f->inertia[8] < HUGE_VAL)) f->inertia[8] = 0.0;
        return PERI_OK;
    }
    for (int r = 0; r < 3; ++r)
        for (int c = r; c < 3; ++c) packed[peri__packed(3, r, c)] = f->inertia[3 * r + c];
    int endless = 0;
    for (int k = 0; k < 3; ++k) endless += !(packed[k] < HUGE_VAL);
    for (int k = 0; k < 3 && endless > 0; ++k) { /* given, so there is no more than a diagonal */
        f->inverse[4 * k] = 1.0 / packed[k];
        if (!(packed[k] < HUGE_VAL)) f->inertia[4 * k] = 0.0;
    }
    if (endless > 0) return PERI_OK;
    if (peri__invert(3, packed, 1e-12, inverse) < 3) return peri__fail(b, PERI_ERROR_RANGE, "inertia", -1, 0.0);
    for (int k = 0; k < 9; ++k) f->inverse[k] = inverse[peri__packed(3, k / 3, k % 3)];
    return PERI_OK;
}

/* Mass, centre and inertia, given or of the shape. */
static int32_t peri__read_mass(peri_body *b, const peri_obstacle_desc *d, const peri__obstacle *o, peri__free_body *f) {
    const peri__model *m = b->model;
    const double unit = peri__mass_unit(m), turn_unit = unit * m->length * m->length;
    peri__bulk bulk;
    peri__solid_bulk(&o->solid, b->dim, &bulk);
    PERI_NEED(b, d->mass > 0.0 || bulk.volume > 0.0, "mass");
    PERI_NEED(b, d->inertia[0] > 0.0 || bulk.volume > 0.0, "inertia");
    f->mass = d->mass > 0.0 ? d->mass / unit : d->density / m->density * bulk.volume;
    if (!(f->mass > 1e-100 && f->mass < 1e100))
        return peri__fail(b, PERI_ERROR_RANGE, d->mass > 0.0 ? "mass" : "density", -1, d->mass > 0.0 ? d->mass : d->density);
    for (int k = 0; k < 9; ++k) f->inertia[k] = d->inertia[0] > 0.0 ? 0.0 : f->mass / bulk.volume * bulk.inertia[k];
    if (d->inertia[0] > 0.0 && b->dim == 2) f->inertia[8] = d->inertia[0] / turn_unit;
    for (int k = 0; d->inertia[0] > 0.0 && b->dim == 3 && k < 3; ++k) f->inertia[4 * k] = d->inertia[k] / turn_unit;
    if (!(d->inertia[0] > 0.0)) memcpy(f->centre, bulk.centre, sizeof f->centre);
    for (int k = b->dim == 2 ? 2 : 0; k < 3; ++k)
        if (!(f->inertia[4 * k] > 1e-100 && (f->inertia[4 * k] < 1e100 || f->inertia[4 * k] == HUGE_VAL)))
            return peri__fail(b, PERI_ERROR_RANGE, "inertia", -1, d->inertia[b->dim == 2 ? 0 : k]);
    return peri__set_inertia(b, f);
}

/* A vector of the caller's, of dim components, in a unit; and a spin. */
static void peri__read_vector(const peri_body *b, const double *given, double unit, double *out) {
    for (int32_t d = 0; d < 3; ++d) out[d] = d < b->dim ? given[d] / unit : 0.0;
}

static void peri__read_spin(const peri_body *b, const double *given, double *out) {
    for (int d = 0; d < 3; ++d) out[d] = b->dim == 3 ? given[d] * b->model->time : 0.0;
    if (b->dim == 2) out[2] = given[0] * b->model->time;
}

static int32_t peri__set_free(peri_body *b, const peri_obstacle_desc *d, peri__obstacle *o) {
    const peri__model *m = b->model;
    double velocity[3], spin[3];
    if (d->mass == 0.0 && d->density == 0.0) return PERI_OK;
    o->free = (peri__free_body *)peri__new(&b->memory, 1, sizeof *o->free);
    if (!o->free) return peri__fail(b, PERI_ERROR_MEMORY, "obstacle", -1, 0.0);
    const int32_t status = peri__read_mass(b, d, o, o->free);
    if (status < 0) return status;
    peri__read_vector(b, d->gravity, m->length / (m->time * m->time), o->free->gravity);
    peri__read_vector(b, d->velocity, peri__velocity_unit(m), velocity);
    peri__read_spin(b, d->spin, spin);
    peri__set_momenta(o, velocity, spin);
    if (!peri__is_bounded(o)) return peri__fail(b, PERI_ERROR_RANGE, "spin", -1, d->spin[0]);
    memcpy(o->free->velocity0, o->free->velocity, sizeof velocity);
    memcpy(o->free->turning0, o->free->turning, sizeof spin);
    peri__update_velocity(o);
    return PERI_OK;
}

/* ---- surface ---------------------------------------------------------------------------------------------------- */

static double peri__default_stiffness(const peri__model *m) { return 1.0 / peri__square(m->spacing); }

static double peri__least_density(const peri_body *b) {
    const peri__model *m = b->model;
    double least = m->rho[0];
    for (int32_t k = 1; k < m->materials; ++k) least = fmin(least, m->rho[k]);
    for (int64_t i = 0; b->density && i < m->points; ++i) least = i == 0 ? b->density[0] : fmin(least, b->density[i]);
    return least;
}

/* w of a restitution e < 1: the root of w - ln(1 + w) + e w + ln(1 - e w) in (0, 1/e). */
static double peri__hysteresis_of(double e) {
    double low = 0.0, high = 1.0 / e;
    for (int k = 0; k < 100; ++k) {
        const double w = 0.5 * (low + high);
        if (e * w < 1.0 && w * (1.0 + e) - log1p(w) + log1p(-e * w) > 0.0) low = w;
        else high = w;
    }
    return low;
}

static int32_t peri__read_surface(peri_body *b, const peri_obstacle_desc *d, peri__obstacle *o) {
    const peri__model *m = b->model;
    o->stiffness = d->stiffness > 0.0 ? d->stiffness * m->length * m->length / m->stress : peri__default_stiffness(m);
    /* they add up in the stable step, over the least density (explicit.c): as many as there are ids stay within double */
    if (!(o->stiffness / peri__least_density(b) < 1e300)) return peri__fail(b, PERI_ERROR_RANGE, "stiffness", -1, d->stiffness);
    o->friction = d->friction;
    o->friction_speed = d->friction_speed > 0.0 ? d->friction_speed / peri__velocity_unit(m) : 1e-6;
    if (!(o->friction_speed > 1e-30)) return peri__fail(b, PERI_ERROR_RANGE, "friction_speed", -1, d->friction_speed);
    o->hysteresis = d->restitution < 1.0 ? peri__hysteresis_of(d->restitution) : 0.0;
    o->lossy = o->friction > 0.0 || o->hysteresis > 0.0;
    if (o->lossy) o->kept = (double *)peri__new(&b->memory, m->points * PERI_KEPT, sizeof *o->kept);
    if (o->lossy || o->free) o->tally = (double *)peri__new(&b->memory, m->blocks * PERI_TALLIED, sizeof *o->tally);
    if ((o->lossy && !o->kept) || ((o->lossy || o->free) && !o->tally))
        return peri__fail(b, PERI_ERROR_MEMORY, "obstacle", -1, 0.0);
    return PERI_OK;
}

/* ---- add, remove ------------------------------------------------------------------------------------------------ */

/* All of a checked descriptor; what it takes is o's, whatever comes of it. */
static int32_t peri__read_obstacle(peri_body *b, const peri_obstacle_desc *d, peri__obstacle *o) {
    const peri__model *m = b->model;
    memset(o, 0, sizeof *o);
    o->kind = d->shape;
    o->motion = d->motion;
    o->user = d->user;
    peri__inner(b, d->place, o->position);
    for (int32_t k = 0; k < b->dim; ++k)
        if (!(fabs(o->position[k]) < (d->shape == PERI_SHAPE_PLANE && d->mass + d->density == 0.0 ? DBL_MAX : 1e15)))
            return peri__fail(b, PERI_ERROR_RANGE, "place", -1, d->place[k]);
    if (!peri__read_turn(b->dim, d->turn, o->turn)) o->turn[0] = 1.0; /* no quaternion: not turned */
    memcpy(o->position0, o->position, sizeof o->position);
    memcpy(o->turn0, o->turn, sizeof o->turn);
    int32_t status = peri__read_shape(b, d, &o->solid);
    if (status < 0) return status;
    peri__update_axes(o, b->dim);
    status = peri__set_free(b, d, o);
    if (status == PERI_OK) status = peri__read_surface(b, d, o);
    if (status < 0) return status;
    if (!peri__grow(&b->memory, &b->obstacles, &b->obstacle_capacity, b->obstacle_count + 1, sizeof *b->obstacles))
        return peri__fail(b, PERI_ERROR_MEMORY, "obstacle", -1, 0.0);
    if (!b->push) b->push = (double *)peri__new(&b->memory, m->stride * m->dim, sizeof *b->push);
    return b->push ? PERI_OK : peri__fail(b, PERI_ERROR_MEMORY, "obstacle", -1, 0.0);
}

PERI_API int32_t peri_add_obstacle(peri_body *b, const peri_obstacle_desc *d) {
    peri__obstacle obstacle;
    PERI_NEED_CHANGEABLE(b);
    int32_t status = peri__check_obstacle(b, d);
    if (status == PERI_OK && b->model->part && d->mass + d->density > 0.0) status = peri__fail(b, PERI_ERROR_PART, "mass", -1, d->mass);
    if (status == PERI_OK) status = peri__check_room(b, PERI_KIND_OBSTACLE, PERI_ID_LIMIT, "obstacle");
    if (status < 0) return status;
    status = peri__read_obstacle(b, d, &obstacle);
    if (status < 0) {
        peri__free_obstacle(b, &obstacle);
        return status;
    }
    b->obstacles[b->obstacle_count++] = obstacle;
    peri__changed(b, PERI__ACTION);
    return peri__id(b, PERI_KIND_OBSTACLE, b->obstacle_count - 1);
}

PERI_API int32_t peri_remove_obstacle(peri_body *b, int32_t id) {
    PERI_NEED_CHANGEABLE(b);
    const int64_t obstacle = peri__find(b, PERI_KIND_OBSTACLE, id, "obstacle");
    if (obstacle < 0) return (int32_t)obstacle;
    peri__free_obstacle(b, &b->obstacles[obstacle]);
    b->obstacles[obstacle].kind = PERI__REMOVED;
    peri__changed(b, PERI__ACTION);
    return PERI_OK;
}

/* ---- state ------------------------------------------------------------------------------------------------------ */

/* The energy in what an obstacle touches, or the status of a callback. */
static int32_t peri__sum_stored(peri_body *b, const peri__obstacle *o, double *stored) {
    *stored = 0.0;
    for (int64_t i = 0; i < b->model->points; ++i) {
        peri__dip t;
        if (peri__is_ghost(b->model, i)) continue;
        const int32_t touches = peri__dips(b, o, i, 0.0, &t);
        if (touches < 0) return touches;
        if (touches) *stored += 0.5 * o->stiffness * t.depth * t.depth * b->model->volume[i];
    }
    return PERI_OK;
}

PERI_API int32_t peri_get_obstacle_state(peri_body *b, int32_t id, peri_obstacle_state *state) {
    double stored = 0.0;
    PERI_NEED_BUILT(b);
    const int64_t at = peri__find(b, PERI_KIND_OBSTACLE, id, "obstacle");
    if (at < 0) return (int32_t)at;
    PERI_NEED(b, state, "state");
    const peri__model *m = b->model;
    const peri__obstacle *o = &b->obstacles[at];
    int32_t status = peri__ensure_force(b);
    if (status == PERI_OK) status = peri__sum_stored(b, o, &stored);
    if (status < 0) return status;
    memset(state, 0, sizeof *state);
    for (int32_t d = 0; d < b->dim; ++d) {
        state->place[d] = m->origin[d] + o->position[d] * m->length;
        state->velocity[d] = o->velocity[d] * peri__velocity_unit(m);
    }
    memcpy(state->turn, o->turn, sizeof state->turn);
    for (int d = 0; d < 3; ++d) state->spin[d] = o->spin[d] / m->time;
    if (b->dim == 2) {
        state->spin[0] = state->spin[2];
        state->spin[2] = 0.0;
    }
    state->mass = o->free ? o->free->mass * peri__mass_unit(m) : 0.0;
    state->kinetic = o->free ? peri__free_kinetic(o->free, o->spin) * m->energy : 0.0;
    state->stored = stored * m->energy;
    state->lost = o->lost * m->energy;
    return PERI_OK;
}

PERI_API int32_t peri_set_obstacle_state(peri_body *b, int32_t id, const peri_obstacle_state *state) {
    double velocity[3], spin[3];
    PERI_NEED_CHANGEABLE(b);
    const int64_t at = peri__find(b, PERI_KIND_OBSTACLE, id, "obstacle");
    if (at < 0) return (int32_t)at;
    PERI_NEED(b, state, "state");
    peri__obstacle *o = &b->obstacles[at], moved = *o;
    if (!o->free) return peri__fail(b, PERI_ERROR_CHOICE, "obstacle", id, 0.0);
    peri__free_body momenta = *o->free;
    PERI_NEED_NUMBERS(b, state->place, b->dim);
    PERI_NEED_NUMBERS(b, state->turn, b->dim == 2 ? 1 : 4);
    PERI_NEED_NUMBERS(b, state->velocity, b->dim);
    PERI_NEED_NUMBERS(b, state->spin, b->dim == 2 ? 1 : 3);
    moved.free = &momenta;
    peri__inner(b, state->place, moved.position);
    if (!peri__read_turn(b->dim, state->turn, moved.turn)) moved.turn[0] = 1.0;
    peri__update_axes(&moved, b->dim);
    peri__read_vector(b, state->velocity, peri__velocity_unit(b->model), velocity);
    peri__read_spin(b, state->spin, spin);
    peri__set_momenta(&moved, velocity, spin);
    if (!peri__is_bounded(&moved)) return peri__fail(b, PERI_ERROR_RANGE, "state", -1, 0.0);
    peri__update_velocity(&moved);
    *o->free = momenta;
    moved.free = o->free;
    *o = moved;
    peri__changed(b, PERI__ACTION);
    return PERI_OK;
}
