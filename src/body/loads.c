/* loads.c - supports, loads and obstacles, and their work.

   All work is taken by the trapezoidal rule over a step, 1/2 (F_n + F_n+1).du, with du = dt*v at the half step: the rule under which the
   energy of velocity-Verlet closes to O(dt^2). Loads and obstacles are evaluated after the drift, while v is that half-step velocity,
   so the old and the new force meet the same v and nothing needs to be stored but the old value. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static int64_t peri__dof(const peri_body *b, const peri__load *load, int64_t k, int32_t d) {
    return d * b->model->stride + peri__set_point(b, load->set, k);
}

/* ---- loads and supports ------------------------------------------------------------------------------------------- */

/* A dof belongs to the last support that prescribes it: gives support s its dofs, and takes them from those before it. */
static void peri__assign_support(peri_body *b, int64_t s) {
    peri__load *load = &b->loads[s];
    if (load->owned) memset(load->owned, load->axes, (size_t)load->count);
    for (int64_t e = 0; load->owned && e < s; ++e) {
        peri__load *earlier = &b->loads[e];
        int64_t a = 0, c = 0;
        if (!earlier->owned) continue;
        while (a < earlier->count && c < load->count) { /* both ascending */
            int32_t p = peri__set_point(b, earlier->set, a), q = peri__set_point(b, load->set, c);
            if (p == q) earlier->owned[a] = (uint8_t)(earlier->owned[a] & ~load->axes);
            if (p <= q) a++;
            if (q <= p) c++;
        }
    }
}

static int32_t peri__add_load(peri_body *b, int32_t kind, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                              void *user) {
    peri__load load;
    int support = kind != PERI__FORCE;
    int32_t status = peri__check_set(b, set);
    if (status < 0) return status;
    PERI_NEED(b, value || fn || support, "value");
    PERI_NEED(b, axes > 0 && axes < 1 << b->dim, "axes");
    if (value && !peri__finite_vector(value, b->dim)) return peri__fail(b, PERI_ERROR_RANGE, "value", -1, 0.0);
    memset(&load, 0, sizeof load);
    load.kind = kind;
    load.set = set;
    load.axes = axes;
    load.fn = fn;
    load.user = user;
    load.per_value = 1.0;
    load.count = peri__set_count(b, set);
    for (int32_t d = 0; value && d < b->dim; ++d) load.constant[d] = value[d];
    if (!peri__grow(&b->memory, &b->loads, &b->load_capacity, b->load_count + 1, sizeof *b->loads))
        return peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
    if (fn) load.value = (double *)peri__new(&b->memory, load.count * b->dim, sizeof(double));
    if (fn && set == PERI_ALL) load.all = (int32_t *)peri__new(&b->memory, load.count, sizeof *load.all);
    if (support) load.force = (double *)peri__new(&b->memory, PERI__HELD_PLANES * load.count * b->dim, sizeof(double));
    if (support) load.owned = (uint8_t *)peri__new(&b->memory, load.count, 1);
    if ((fn && !load.value) || (fn && set == PERI_ALL && !load.all) || (support && (!load.force || !load.owned))) {
        peri__free_load(b, &load);
        return peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
    }
    for (int64_t k = 0; load.all && k < load.count; ++k) load.all[k] = (int32_t)k;
    b->loads[b->load_count++] = load;
    b->force_current = 0;
    peri__assign_support(b, b->load_count - 1);
    return (int32_t)(b->load_count - 1);
}

PERI_API int32_t peri_prescribe_displacement(peri_body *b, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                                             void *user) {
    PERI_NEED_CHANGEABLE(b);
    return peri__add_load(b, PERI__DISPLACEMENT, set, axes, value, fn, user);
}

PERI_API int32_t peri_prescribe_velocity(peri_body *b, int32_t set, int32_t axes, const double *value, peri_load_fn fn,
                                         void *user) {
    PERI_NEED_CHANGEABLE(b);
    return peri__add_load(b, PERI__VELOCITY, set, axes, value, fn, user);
}

PERI_API int32_t peri_apply_body_force(peri_body *b, int32_t set, const double *value, peri_load_fn fn, void *user) {
    PERI_NEED_CHANGEABLE(b);
    return peri__add_load(b, PERI__FORCE, set, (1 << b->dim) - 1, value, fn, user);
}

PERI_API int32_t peri_apply_traction(peri_body *b, int32_t set, double area, const double *value, peri_load_fn fn,
                                     void *user) {
    double volume = 0.0;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_NUMBER(b, area > 0.0, area);
    int32_t status = peri__check_set(b, set);
    if (status < 0) return status;
    const peri__model *m = b->model;
    for (int64_t k = 0; k < peri__set_count(b, set); ++k) volume += m->volume[peri__set_point(b, set, k)];
    status = peri__add_load(b, PERI__FORCE, set, (1 << b->dim) - 1, value, fn, user);
    if (status >= 0) b->loads[status].per_value = area / (volume * pow(m->length, b->dim));
    return status;
}

static int32_t peri__check_load(peri_body *b, int32_t load) {
    if (load < 0 || load >= b->load_count || b->loads[load].kind == PERI__FREE)
        return peri__fail(b, PERI_ERROR_ID, "load", load, 0.0);
    return PERI_OK;
}

PERI_API int32_t peri_remove_load(peri_body *b, int32_t load) {
    PERI_NEED_CHANGEABLE(b);
    int32_t status = peri__check_load(b, load);
    if (status < 0) return status;
    const int support = b->loads[load].owned != NULL;
    peri__free_load(b, &b->loads[load]);
    b->loads[load].kind = PERI__FREE;
    b->force_current = 0;
    for (int64_t s = 0; support && s < b->load_count; ++s) peri__assign_support(b, s);
    return PERI_OK;
}

/* Component d of the value of point k of a load, user's units. */
static double peri__load_value(const peri_body *b, const peri__load *load, int64_t k, int32_t d) {
    return load->fn ? load->value[k * b->dim + d] : b->load_factor * load->constant[d];
}

/* Component d of the force density that a load gives to its point k, inner units. */
static double peri__load_force(const peri_body *b, const peri__load *load, int64_t k, int32_t d) {
    double sum = 0.0, unit = load->per_value / peri__force_unit(b->model);
    if (!load->spread) return unit * peri__load_value(b, load, k, d);
    for (int32_t c = 0; c < b->dim; ++c) sum += load->spread[(k * b->dim + d) * b->dim + c] * peri__load_value(b, load, k, c);
    return unit * sum;
}

/* Asks the callback for its values at a time. */
static int32_t peri__refresh_load(peri_body *b, peri__load *load, double time) {
    if (!load->fn) return PERI_OK;
    for (int64_t k = 0; k < load->count; ++k)
        for (int32_t d = 0; d < b->dim; ++d) load->value[k * b->dim + d] = load->constant[d];
    load->fn(load->user, time, load->count, load->all ? load->all : b->sets[load->set - 1].points,
             load->value);
    for (int64_t k = 0; k < load->count * b->dim; ++k)
        if (!peri__finite(load->value[k]))
            return peri__fail(b, PERI_ERROR_CALLBACK, "load at the point", peri__set_point(b, load->set, k / b->dim), load->value[k]);
    return PERI_OK;
}

/* sum over the load's points of b.v V, inner units of power */
static double peri__load_power(const peri_body *b, const peri__load *load) {
    const peri__model *m = b->model;
    double power = 0.0;
    for (int64_t k = 0; k < load->count; ++k)
        for (int32_t d = 0; d < m->dim; ++d)
            power += peri__load_force(b, load, k, d) * peri__get_real(b->v, b->f32, peri__dof(b, load, k, d))
                   * m->volume[peri__set_point(b, load->set, k)];
    return power;
}

/* Adds all loads at `time` to f; dt > 0: counts the work of the step that ends there. */
static int32_t peri__apply_loads(peri_body *b, double time, double dt) {
    const peri__model *m = b->model;
    for (int64_t s = 0; s < b->load_count; ++s) {
        peri__load *load = &b->loads[s];
        if (load->kind != PERI__FORCE) continue;
        if (b->desc.ledger && dt > 0.0) b->ledger.external += 0.5 * dt * peri__load_power(b, load);
        int32_t status = peri__refresh_load(b, load, time);
        if (status < 0) return status;
        if (b->desc.ledger && dt > 0.0) b->ledger.external += 0.5 * dt * peri__load_power(b, load);
        for (int64_t k = 0; k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t at = peri__dof(b, load, k, d);
                double force = peri__get_real(b->f, b->f32, at) + peri__load_force(b, load, k, d);
                if (!(fabs(force) < (b->f32 ? FLT_MAX : DBL_MAX)))
                    return peri__fail(b, PERI_ERROR_RANGE, "load at the point", peri__set_point(b, load->set, k), force);
                peri__put_real(b->f, b->f32, at, force);
            }
    }
    return PERI_OK;
}

static double *peri__held(const peri_body *b, const peri__load *load, int plane, int64_t k, int32_t d) {
    return &load->force[(plane * load->count + k) * b->dim + d];
}

/* Before the kick of a step: sets v of the supported dofs to what carries them through the step, and f to what keeps it there under
   damping (alpha rho v). The work of a support is what its dof gains in kinetic energy and gives to damping, less the work of all other
   forces, 1/2 (F_n + F_n+1).du; peri__hold_supports adds the second halves. */
static int32_t peri__drive_supports(peri_body *b, double dt, double damping) {
    const peri__model *m = b->model;
    for (int64_t s = 0; s < b->load_count; ++s) {
        peri__load *load = &b->loads[s];
        if (!load->owned) continue;
        int32_t status = peri__refresh_load(b, load, b->time + dt * m->time);
        if (status < 0) return status;
        load->stepped = 1;
        for (int64_t k = 0; k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t i = peri__set_point(b, load->set, k), at = peri__dof(b, load, k, d);
                double rho = m->rho[m->material[i]], value = peri__load_value(b, load, k, d), v, work;
                double *old = peri__held(b, load, PERI__HELD_VALUE, k, d), force, before;
                if (!(load->owned[k] >> d & 1)) continue;
                if (load->kind == PERI__DISPLACEMENT) {
                    value /= m->length;
                    if (b->f32) value = (float)value; /* what u can hold: else it would move for ever by what is left over */
                    v = (value - peri__get_real(b->u, b->f32, at)) / dt;
                } else {
                    value /= peri__velocity_unit(m);
                    v = 0.5 * (*old + value);
                }
                *old = value;
                peri__put_real(b->v, b->f32, at, v);
                v = *peri__held(b, load, PERI__HELD_VELOCITY, k, d) = peri__get_real(b->v, b->f32, at);
                peri__put_real(b->f, b->f32, at, damping * rho * v);
                force = *peri__held(b, load, PERI__HELD_FORCE, k, d);
                before = *peri__held(b, load, PERI__HELD_ENERGY, k, d);
                work = 0.5 * rho * (v * v - before * before) - 0.5 * dt * force * v;
                *peri__held(b, load, PERI__HELD_REACTION, k, d) =
                    rho * (v - (1.0 - 0.5 * damping * dt) * before) / dt - 0.5 * force;
                if (b->desc.ledger) b->ledger.external += work * m->volume[i];
            }
    }
    return PERI_OK;
}

/* After the forces of the new time: keeps them for the reaction and the ledger, and sets f to what kicks the supported dofs from the
   velocity of the step to that of its end: the prescribed one, or the mean of the step where displacement is prescribed. */
static void peri__hold_supports(peri_body *b, double dt, double damping) {
    const peri__model *m = b->model;
    for (int64_t s = 0; s < b->load_count; ++s) {
        peri__load *load = &b->loads[s];
        if (!load->owned) continue;
        for (int64_t k = 0; k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t i = peri__set_point(b, load->set, k), at = peri__dof(b, load, k, d);
                double rho = m->rho[m->material[i]], force = peri__get_real(b->f, b->f32, at);
                double v = *peri__held(b, load, PERI__HELD_VELOCITY, k, d), end = v, kicked, need;
                if (!(load->owned[k] >> d & 1)) continue;
                *peri__held(b, load, PERI__HELD_FORCE, k, d) = force;
                if (load->kind == PERI__VELOCITY) end = *peri__held(b, load, PERI__HELD_VALUE, k, d);
                /* bonds that broke in this step have kicked v away from what is prescribed */
                kicked = rho * (peri__get_real(b->v, b->f32, at) - v);
                if (b->desc.ledger)
                    b->ledger.external += (0.5 * rho * (end * end - v * v) - (0.5 * dt * force + kicked) * v) * m->volume[i];
                *peri__held(b, load, PERI__HELD_ENERGY, k, d) = end;
                need = 2.0 * rho * ((1.0 + 0.5 * damping * dt) * end - v) / dt;
                peri__put_real(b->v, b->f32, at, v);
                peri__put_real(b->f, b->f32, at, need);
                *peri__held(b, load, PERI__HELD_REACTION, k, d) += 0.5 * (need - force) - kicked / dt;
            }
    }
}

/* The same without a step, where forces were taken at a state that the caller may have changed. */
static int32_t peri__meet_supports(peri_body *b) {
    const peri__model *m = b->model;
    for (int64_t s = 0; s < b->load_count; ++s) {
        peri__load *load = &b->loads[s];
        if (!load->owned) continue;
        int32_t status = load->kind == PERI__VELOCITY ? peri__refresh_load(b, load, peri__load_time(b)) : PERI_OK;
        if (status < 0) return status;
        for (int64_t k = 0; k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t at = peri__dof(b, load, k, d);
                if (!(load->owned[k] >> d & 1)) continue;
                *peri__held(b, load, PERI__HELD_FORCE, k, d) = peri__get_real(b->f, b->f32, at);
                *peri__held(b, load, PERI__HELD_ENERGY, k, d) = peri__get_real(b->v, b->f32, at);
                if (!load->stepped) *peri__held(b, load, PERI__HELD_REACTION, k, d) = -peri__get_real(b->f, b->f32, at);
                *peri__held(b, load, PERI__HELD_VALUE, k, d) = peri__load_value(b, load, k, d) / peri__velocity_unit(m);
                peri__put_real(b->f, b->f32, at, 0.0);
            }
    }
    return PERI_OK;
}

/* The supports make good what the coming kick will take from their dofs by damping: the same formula as in the kick itself. */
static void peri__supply_supports(peri_body *b, const peri__step *step) {
    const peri__model *m = b->model;
    if (step->loss_old == 0.0 && step->loss_new == 0.0) return;
    for (int64_t s = 0; s < b->load_count; ++s) {
        const peri__load *load = &b->loads[s];
        for (int64_t k = 0; load->owned && k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t i = peri__set_point(b, load->set, k), at = peri__dof(b, load, k, d);
                double rho = m->rho[m->material[i]], old = peri__get_real(b->v, b->f32, at);
                double now = step->keep * old + step->kick / rho * peri__get_real(b->f, b->f32, at);
                if (!(load->owned[k] >> d & 1)) continue;
                b->ledger.external += (step->loss_old * old + step->loss_new * now) * 0.5 * (old + now) * rho * m->volume[i];
            }
    }
}

/* ---- obstacles ---------------------------------------------------------------------------------------------------- */

static double peri__default_stiffness(const peri__model *m) { return 1.0 / peri__square(m->spacing); }

static int32_t peri__add_obstacle(peri_body *b, peri__obstacle *obstacle, const double *place, double stiffness) {
    const peri__model *m = b->model;
    int64_t vector = m->stride * m->dim;
    PERI_NEED_NUMBER(b, stiffness >= 0.0, stiffness);
    peri__inner(b, place, obstacle->place);
    for (int32_t d = 0; d < b->dim; ++d) /* beyond 1e15 spacings the surface of a ball is lost in rounding */
        if (!(fabs(obstacle->place[d]) < (obstacle->kind == PERI__BALL ? 1e15 : DBL_MAX)))
            return peri__fail(b, PERI_ERROR_RANGE, obstacle->kind == PERI__BALL ? "centre" : "place", -1, place[d]);
    if (!(obstacle->radius < 1e15)) return peri__fail(b, PERI_ERROR_RANGE, "radius", -1, obstacle->radius * m->length);
    memcpy(obstacle->place0, obstacle->place, sizeof obstacle->place0);
    obstacle->stiffness = stiffness > 0.0 ? stiffness * m->length * m->length / m->stress : peri__default_stiffness(m);
    if (!peri__grow(&b->memory, &b->obstacles, &b->obstacle_capacity, b->obstacle_count + 1, sizeof *b->obstacles))
        return peri__fail(b, PERI_ERROR_MEMORY, "obstacle", -1, 0.0);
    if (!b->push) b->push = (double *)peri__new(&b->memory, vector, sizeof *b->push);
    if (!b->push) return peri__fail(b, PERI_ERROR_MEMORY, "obstacle", -1, 0.0);
    b->obstacles[b->obstacle_count++] = *obstacle;
    b->force_current = 0;
    return (int32_t)(b->obstacle_count - 1);
}

PERI_API int32_t peri_add_plane_obstacle(peri_body *b, const double *place, const double *normal, double stiffness,
                                         peri_motion_fn motion, void *user) {
    peri__obstacle obstacle;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_VECTOR(b, place);
    PERI_NEED_VECTOR(b, normal);
    memset(&obstacle, 0, sizeof obstacle);
    if (!peri__direction(normal, b->dim, obstacle.normal)) return peri__fail(b, PERI_ERROR_RANGE, "normal", -1, 0.0);
    obstacle.kind = PERI__PLANE;
    obstacle.motion = motion;
    obstacle.user = user;
    return peri__add_obstacle(b, &obstacle, place, stiffness);
}

PERI_API int32_t peri_add_ball_obstacle(peri_body *b, const double *centre, double radius, double stiffness,
                                        peri_motion_fn motion, void *user) {
    peri__obstacle obstacle;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_VECTOR(b, centre);
    PERI_NEED_NUMBER(b, radius > 0.0, radius);
    memset(&obstacle, 0, sizeof obstacle);
    obstacle.kind = PERI__BALL;
    obstacle.radius = radius / b->model->length;
    obstacle.motion = motion;
    obstacle.user = user;
    return peri__add_obstacle(b, &obstacle, centre, stiffness);
}

/* Moves the obstacles to where they are at `time`. */
static int32_t peri__move_obstacles(peri_body *b, double time) {
    for (int64_t k = 0; k < b->obstacle_count; ++k) {
        peri__obstacle *o = &b->obstacles[k];
        double place[3] = { 0.0, 0.0, 0.0 };
        if (o->kind == PERI__REMOVED || !o->motion) continue;
        for (int32_t d = 0; d < b->dim; ++d) place[d] = b->model->origin[d] + o->place0[d] * b->model->length;
        o->motion(o->user, time, place);
        if (!peri__finite_vector(place, b->dim)) return peri__fail(b, PERI_ERROR_CALLBACK, "motion of the obstacle", k, 0.0);
        peri__inner(b, place, o->place);
    }
    return PERI_OK;
}

/* Adds the force density of one obstacle on point i to push[dim]. */
static void peri__push(const peri_body *b, const peri__obstacle *o, int64_t i, double *push) {
    const peri__model *m = b->model;
    double r[3], depth, square = 0.0;
    if (o->kind == PERI__REMOVED) return;
    for (int32_t d = 0; d < m->dim; ++d) {
        int64_t at = d * m->stride + i;
        r[d] = peri__get_real(m->x, b->f32, at) + peri__get_real(b->u, b->f32, at) - o->place[d];
        square += r[d] * r[d];
    }
    if (o->kind == PERI__BALL) {
        double distance = sqrt(square);
        depth = o->radius - distance;
        for (int32_t d = 0; depth > 0.0 && d < m->dim; ++d) push[d] += o->stiffness * depth * r[d] / (distance + 1e-290);
    } else {
        depth = -peri__dot(o->normal, r, m->dim);
        for (int32_t d = 0; depth > 0.0 && d < m->dim; ++d) push[d] += o->stiffness * depth * o->normal[d];
    }
}

typedef struct peri__pusher {
    peri_body *body;
    double     half_step; /* dt/2                                                                                         */
} peri__pusher;

/* sums->a: work of old and new push. */
static void peri__push_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__pusher *pusher = (const peri__pusher *)context;
    peri_body *b = pusher->body;
    const peri__model *m = b->model;
    for (int64_t i = begin; i < end; ++i) {
        double push[3] = { 0.0, 0.0, 0.0 }, work = 0.0;
        for (int64_t k = 0; k < b->obstacle_count; ++k) peri__push(b, &b->obstacles[k], i, push);
        for (int32_t d = 0; d < m->dim; ++d) {
            int64_t at = d * m->stride + i;
            work += (b->push[at] + push[d]) * peri__get_real(b->v, b->f32, at);
            b->push[at] = push[d];
            if (push[d] != 0.0) peri__put_real(b->f, b->f32, at, peri__get_real(b->f, b->f32, at) + push[d]);
        }
        sums->a += pusher->half_step * work * m->volume[i];
    }
}

/* Adds all obstacles at `time` to f; dt > 0: counts the work of the step that ends there. */
static int32_t peri__apply_obstacles(peri_body *b, double time, double dt) {
    peri__pusher pusher = { b, 0.5 * dt };
    if (b->obstacle_count == 0) return PERI_OK;
    int32_t status = peri__move_obstacles(b, time);
    if (status < 0) return status;
    peri__for_points(b, b->model->points, 4 * b->obstacle_count, peri__push_block, &pusher, b->sums);
    if (b->desc.ledger && dt > 0.0) b->ledger.obstacle += peri__total(b->sums, b->model->points).a;
    return PERI_OK;
}

static int32_t peri__check_obstacle(peri_body *b, int32_t obstacle) {
    if (obstacle < 0 || obstacle >= b->obstacle_count || b->obstacles[obstacle].kind == PERI__REMOVED)
        return peri__fail(b, PERI_ERROR_ID, "obstacle", obstacle, 0.0);
    return PERI_OK;
}

PERI_API int32_t peri_remove_obstacle(peri_body *b, int32_t obstacle) {
    PERI_NEED_CHANGEABLE(b);
    int32_t status = peri__check_obstacle(b, obstacle);
    if (status < 0) return status;
    b->obstacles[obstacle].kind = PERI__REMOVED;
    b->force_current = 0;
    return PERI_OK;
}

/* Adds the force of all bonds to f, by the present displacement, and notes or breaks those that meet their criterion; counts the work on
   them where step->working. */
static void peri__bond_forces(peri_body *b, peri__step *step) {
    const peri__model *m = b->model;
    peri__sum_bonds(b, step, b->sums);
    if (step->working) memcpy(b->worked, b->u, (size_t)(m->stride * m->dim) * peri__real(b));
}

/* Brings f up to date with u, loads and cracks as they are, without breaking anything. */
static int32_t peri__update_force(peri_body *b) {
    peri__step step = peri__no_step(b);
    const peri__model *m = b->model;
    int32_t running = b->running;
    if (b->force_current) return PERI_OK;
    b->running = 2;
    peri__update_lanes(b);
    peri__refresh(b);
    memset(b->f, 0, (size_t)(m->stride * m->dim) * peri__real(b));
    int32_t status = peri__apply_loads(b, peri__load_time(b), 0.0);
    if (status == PERI_OK) status = peri__apply_obstacles(b, peri__load_time(b), 0.0);
    if (status == PERI_OK) {
        step.working = m->works;
        peri__bond_forces(b, &step);
        status = peri__meet_supports(b);
    }
    b->running = running;
    b->force_current = status == PERI_OK;
    return status;
}

PERI_API int32_t peri_read_obstacle_force(peri_body *b, int32_t obstacle, double *force) {
    PERI_NEED_BUILT(b);
    int32_t status = peri__check_obstacle(b, obstacle);
    if (status < 0) return status;
    PERI_NEED(b, force, "force");
    if (b->running < 2) status = peri__update_force(b); /* moves the obstacle to where it is now */
    if (status < 0) return status;
    const peri__model *m = b->model;
    double total[3] = { 0.0, 0.0, 0.0 };
    for (int64_t i = 0; i < m->points; ++i) {
        double push[3] = { 0.0, 0.0, 0.0 };
        peri__push(b, &b->obstacles[obstacle], i, push);
        for (int32_t d = 0; d < m->dim; ++d) total[d] += push[d] * m->volume[i];
    }
    for (int32_t d = 0; d < m->dim; ++d) force[d] = total[d] * m->energy / m->length;
    return PERI_OK;
}

/* Force density of the supports on every point, user's units. */
static void peri__read_reactions(const peri_body *b, double *out) {
    const peri__model *m = b->model;
    for (int64_t k = 0; k < m->points * m->dim; ++k) out[k] = 0.0;
    for (int64_t s = 0; s < b->load_count; ++s) {
        const peri__load *load = &b->loads[s];
        for (int64_t k = 0; load->owned && k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d)
                if (load->owned[k] >> d & 1)
                    out[peri__set_point(b, load->set, k) * m->dim + d] = *peri__held(b, load, PERI__HELD_REACTION, k, d);
    }
}

PERI_API int32_t peri_read_reaction(peri_body *b, int32_t id, double *force) {
    PERI_NEED_BUILT(b);
    int32_t status = peri__check_load(b, id);
    if (status < 0) return status;
    PERI_NEED(b, force, "force");
    if (b->running < 2) status = peri__update_force(b);
    if (status < 0) return status;
    const peri__model *m = b->model;
    const peri__load *load = &b->loads[id];
    double total[3] = { 0.0, 0.0, 0.0 };
    for (int64_t k = 0; k < load->count; ++k)
        for (int32_t d = 0; d < m->dim; ++d) {
            double volume = m->volume[peri__set_point(b, load->set, k)];
            if (load->owned && !(load->owned[k] >> d & 1)) continue;
            if (load->owned) total[d] += *peri__held(b, load, PERI__HELD_REACTION, k, d) * volume;
            else total[d] += peri__load_force(b, load, k, d) * volume;
        }
    for (int32_t d = 0; d < m->dim; ++d) force[d] = total[d] * m->energy / m->length;
    return PERI_OK;
}
