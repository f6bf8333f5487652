/* SPDX-License-Identifier: MIT */
/* loads.c - what loads and supports do to the force, and their work.

   All work is taken by the trapezoidal rule over a step, 1/2 (F_n + F_n+1).du, with du = dt*v at the half step: the rule under which the
   energy of velocity-Verlet closes to O(dt^2). Loads and obstacles are evaluated after the drift, while v is that half-step velocity,
   so the old and the new force meet the same v and nothing needs to be stored but the old value. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static int64_t peri__dof(const peri_body *b, const peri__load *load, int64_t k, int32_t d) {
    return d * b->model->stride + peri__set_point(b, load->set, k);
}

/* Component d of the value of point k of a load, user's units, by what its callback wrote, if it has one; constants act by `factor`. */
static double peri__value_by(const peri_body *b, const peri__load *load, const double *wrote, double factor, int64_t k, int32_t d) {
    if (wrote) return wrote[k * b->dim + d];
    return load->kind == PERI__VELOCITY ? load->constant[d] : factor * load->constant[d];
}

/* Component d of the force density that a load gives to its point k, inner units, likewise. */
static double peri__force_by(const peri_body *b, const peri__load *load, const double *wrote, double factor, int64_t k, int32_t d) {
    double sum = 0.0, unit = load->per_value / peri__force_unit(b->model);
    if (!load->spread) return unit * peri__value_by(b, load, wrote, factor, k, d);
    for (int32_t c = 0; c < b->dim; ++c)
        sum += load->spread[(k * b->dim + d) * b->dim + c] * peri__value_by(b, load, wrote, factor, k, c);
    return unit * sum;
}

/* (R - 1) x of the rotation vector w, by Rodrigues: w x x sin t/t + w x (w x x) (1 - cos t)/t^2, t = |w|; w x x of small motion. */
static void peri__turn(int linear, const double *w, const double *x, double *out) {
    double once[3], twice[3];
    const double t = sqrt(peri__dot(w, w, 3)), half = 0.5 * t > 0.0 ? sin(0.5 * t) / (0.5 * t) : 1.0;
    peri__cross(w, x, once);
    peri__cross(w, once, twice);
    for (int d = 0; d < 3; ++d) out[d] = linear ? once[d] : (t > 0.0 ? sin(t) / t : 1.0) * once[d] + 0.5 * half * half * twice[d];
}

/* The displacements of a rigid set at a time. */
static int32_t peri__refresh_rigid(peri_body *b, peri__load *load, double time) {
    const peri__model *m = b->model;
    const int32_t dim = m->dim, turns = dim == 3 ? 3 : 1;
    const double factor = load->motion ? 1.0 : b->now.load_factor;
    double motion[6] = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, turn[3] = { 0.0, 0.0, 0.0 };
    for (int32_t d = 0; d < dim; ++d) motion[d] = factor * load->constant[d];
    for (int32_t d = 0; d < turns; ++d) motion[dim + d] = factor * load->turn[3 - turns + d];
    const int32_t said = load->motion ? load->motion(load->user, time, motion) : 0;
    if (said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, "peri_rigid_fn", -1, said);
    if (said > 0) b->stop = 1;
    if (!peri__finite_vector(motion, dim + turns))
        return peri__fail(b, PERI_ERROR_CALLBACK, "motion", -1, peri__not_finite(motion, dim + turns));
    for (int32_t d = 0; d < turns; ++d) turn[3 - turns + d] = motion[dim + d];
    for (int64_t k = 0; k < load->count; ++k) {
        double x[3] = { 0.0, 0.0, 0.0 }, way[3];
        for (int32_t d = 0; d < dim; ++d)
            x[d] = m->origin[d] + m->length * peri__get_real(m->x, b->f32, peri__dof(b, load, k, d)) - load->centre[d];
        peri__turn(b->desc.geometry == PERI_GEOMETRY_LINEAR, turn, x, way);
        for (int32_t d = 0; d < dim; ++d) load->value[k * dim + d] = motion[d] + way[d];
    }
    return PERI_OK;
}

static double peri__load_value(const peri_body *b, const peri__load *load, int64_t k, int32_t d) {
    return peri__value_by(b, load, load->value, b->now.load_factor, k, d);
}

static double peri__load_force(const peri_body *b, const peri__load *load, int64_t k, int32_t d) {
    return peri__force_by(b, load, load->value, b->now.load_factor, k, d);
}

/* Has the callback write its values at a time to wrote[count*dim]. */
static int32_t peri__ask_load(peri_body *b, const peri__load *load, double time, double *wrote) {
    for (int64_t k = 0; k < load->count; ++k)
        for (int32_t d = 0; d < b->dim; ++d) wrote[k * b->dim + d] = load->constant[d];
    const int32_t *points = load->all ? load->all : b->sets[load->set - 1].points;
    const int32_t said = load->fn(load->user, time, load->count, points, wrote);
    if (said < 0) return peri__fail(b, PERI_ERROR_CALLBACK, "peri_load_fn", -1, said);
    if (said > 0) b->stop = 1;
    for (int64_t k = 0; k < load->count * b->dim; ++k)
        if (!peri__finite(wrote[k]))
            return peri__fail(b, PERI_ERROR_CALLBACK, "value", peri__set_point(b, load->set, k / b->dim), wrote[k]);
    return PERI_OK;
}

static int32_t peri__refresh_load(peri_body *b, peri__load *load, double time) {
    if (load->rigid) return peri__refresh_rigid(b, load, time);
    return load->fn ? peri__ask_load(b, load, time, load->value) : PERI_OK;
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

/* Adds a load to f, which is laid out as b->f. */
static int32_t peri__give_load(peri_body *b, const peri__load *load, const double *wrote, double factor, void *f) {
    const peri__model *m = b->model;
    const double most = peri__most_force(b);
    for (int64_t k = 0; k < load->count; ++k)
        for (int32_t d = 0; d < m->dim; ++d) {
            int64_t at = peri__dof(b, load, k, d);
            double force = peri__get_real(f, b->f32, at) + peri__force_by(b, load, wrote, factor, k, d);
            if (!(fabs(force) < most))
                return peri__fail(b, PERI_ERROR_RANGE, "value", peri__set_point(b, load->set, k), force * peri__force_unit(m));
            peri__put_real(f, b->f32, at, force);
        }
    return PERI_OK;
}

/* Adds all loads at `time` to f; dt > 0: counts the work of the step that ends there. */
static int32_t peri__apply_loads(peri_body *b, double time, double dt) {
    for (int64_t s = 0; s < b->load_count; ++s) {
        peri__load *load = &b->loads[s];
        if (load->kind != PERI__FORCE) continue;
        if (b->desc.ledger && dt > 0.0) b->now.ledger.external += 0.5 * dt * peri__load_power(b, load);
        int32_t status = peri__refresh_load(b, load, time);
        if (status < 0) return status;
        if (b->desc.ledger && dt > 0.0) b->now.ledger.external += 0.5 * dt * peri__load_power(b, load);
        status = peri__give_load(b, load, load->value, b->now.load_factor, b->f);
        if (status < 0) return status;
    }
    return PERI_OK;
}

/* The same to f at a time and a load factor that are not those of the body, which keeps nothing of it. */
static int32_t peri__apply_loads_at(peri_body *b, double time, double factor, void *f) {
    int32_t status = PERI_OK;
    for (int64_t s = 0; s < b->load_count && status == PERI_OK; ++s) {
        const peri__load *load = &b->loads[s];
        const int64_t reals = load->count * b->dim;
        double *wrote = NULL;
        if (load->kind != PERI__FORCE) continue;
        if (load->fn) {
            wrote = (double *)peri__new(&b->scratch, reals, sizeof *wrote);
            status = wrote ? peri__ask_load(b, load, time, wrote) : peri__fail(b, PERI_ERROR_MEMORY, "load", -1, 0.0);
        }
        if (status == PERI_OK) status = peri__give_load(b, load, wrote, factor, f);
        peri__delete(&b->scratch, wrote, reals, sizeof *wrote);
    }
    return status;
}

static double *peri__support_at(const peri_body *b, const peri__load *load, int plane, int64_t k, int32_t d) {
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
        int32_t status = peri__refresh_load(b, load, b->now.time + dt * m->time);
        if (status < 0) return status;
        load->stepped = 1;
        for (int64_t k = 0; k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t i = peri__set_point(b, load->set, k), at = peri__dof(b, load, k, d);
                double rho = peri__density_at(b, i), value = peri__load_value(b, load, k, d), v, work;
                double *old = peri__support_at(b, load, PERI__SUPPORT_VALUE, k, d), force, before;
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
                v = *peri__support_at(b, load, PERI__SUPPORT_VELOCITY, k, d) = peri__get_real(b->v, b->f32, at);
                peri__put_real(b->f, b->f32, at, damping * rho * v);
                force = *peri__support_at(b, load, PERI__SUPPORT_FORCE, k, d);
                before = *peri__support_at(b, load, PERI__SUPPORT_ENERGY, k, d);
                work = 0.5 * rho * (v * v - before * before) - 0.5 * dt * force * v;
                *peri__support_at(b, load, PERI__SUPPORT_REACTION, k, d) =
                    rho * (v - (1.0 - 0.5 * damping * dt) * before) / dt - 0.5 * force;
                if (b->desc.ledger) b->now.ledger.external += work * m->volume[i];
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
                double rho = peri__density_at(b, i), force = peri__get_real(b->f, b->f32, at);
                double v = *peri__support_at(b, load, PERI__SUPPORT_VELOCITY, k, d), end = v, kicked, need;
                if (!(load->owned[k] >> d & 1)) continue;
                *peri__support_at(b, load, PERI__SUPPORT_FORCE, k, d) = force;
                if (load->kind == PERI__VELOCITY) end = *peri__support_at(b, load, PERI__SUPPORT_VALUE, k, d);
                /* bonds that broke in this step have kicked v away from what is prescribed */
                kicked = rho * (peri__get_real(b->v, b->f32, at) - v);
                if (b->desc.ledger)
                    b->now.ledger.external += (0.5 * rho * (end * end - v * v) - (0.5 * dt * force + kicked) * v) * m->volume[i];
                *peri__support_at(b, load, PERI__SUPPORT_ENERGY, k, d) = end;
                need = 2.0 * rho * ((1.0 + 0.5 * damping * dt) * end - v) / dt;
                peri__put_real(b->v, b->f32, at, v);
                peri__put_real(b->f, b->f32, at, need);
                *peri__support_at(b, load, PERI__SUPPORT_REACTION, k, d) += 0.5 * (need - force) - kicked / dt;
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
                *peri__support_at(b, load, PERI__SUPPORT_FORCE, k, d) = peri__get_real(b->f, b->f32, at);
                *peri__support_at(b, load, PERI__SUPPORT_ENERGY, k, d) = peri__get_real(b->v, b->f32, at);
                if (!load->stepped) *peri__support_at(b, load, PERI__SUPPORT_REACTION, k, d) = -peri__get_real(b->f, b->f32, at);
                *peri__support_at(b, load, PERI__SUPPORT_VALUE, k, d) = peri__load_value(b, load, k, d) / peri__velocity_unit(m);
                peri__put_real(b->f, b->f32, at, 0.0);
            }
    }
    return PERI_OK;
}

/* The supports make good what the coming kick will take from their dofs by damping: the same formula as in the kick itself. */
static void peri__supply_supports(peri_body *b, const peri__operands *operands) {
    const peri__model *m = b->model;
    if (operands->loss_old == 0.0 && operands->loss_new == 0.0) return;
    for (int64_t s = 0; s < b->load_count; ++s) {
        const peri__load *load = &b->loads[s];
        for (int64_t k = 0; load->owned && k < load->count; ++k)
            for (int32_t d = 0; d < m->dim; ++d) {
                int64_t i = peri__set_point(b, load->set, k), at = peri__dof(b, load, k, d);
                double rho = peri__density_at(b, i), old = peri__get_real(b->v, b->f32, at);
                double now = operands->keep * old + operands->kick / rho * peri__get_real(b->f, b->f32, at);
                if (!(load->owned[k] >> d & 1)) continue;
                b->now.ledger.external += (operands->loss_old * old + operands->loss_new * now) * 0.5 * (old + now) * rho * m->volume[i];
            }
    }
}
