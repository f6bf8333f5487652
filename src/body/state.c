/* state.c - changes to displacement and velocity, the energies, and what the ledger must know of changes from outside. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* What passes need of a body, with no step, no breaking and no work. */
static peri__step peri__no_step(const peri_body *b) {
    const peri__model *m = b->model;
    peri__step s;
    memset(&s, 0, sizeof s);
    s.model = m;
    s.u = s.drifted = b->u;
    s.v = b->v;
    s.f = b->f;
    s.pack = b->pack;
    if (b->constant) {
        s.constant = (const char *)b->constant + (size_t)m->margin * peri__bond_real(b);
        s.response = (char *)b->response + (size_t)m->margin * peri__bond_real(b);
    }
    s.alive = b->alive;
    s.dying = b->dying;
    s.masks = b->lanes_alive;
    s.cls = b->cls;
    s.pairs = b->pairs;
    s.classes = b->classes;
    s.central = b->central;
    s.work = b->work;
    s.pull = b->pull;
    s.worked = b->worked;
    s.node = b->node;
    s.linear = b->desc.geometry == PERI_LINEAR;
    return s;
}

static double peri__kinetic_energy(peri_body *b) {
    peri__step step = peri__no_step(b);
    peri__for_points(b, b->model->points, 1, b->ops->kinetic, &step, b->sums);
    return peri__total(b->sums, b->model->points).a;
}

/* The largest energy of a node that may lose a bond by it. */
static double peri__most_node_energy(const peri__step *s) {
    double most = 0.0;
    for (int64_t i = 0; i < s->model->points; ++i)
        if (s->node[i] > most && peri__least_node_energy(s, i) < PERI_NEVER) most = s->node[i];
    return most;
}

/* Adds the force of all bonds to step->f, by step->u; b: whose threads do it. */
static void peri__sum_bonds(const peri_body *b, peri__step *step, peri__sums *sums) {
    const peri__model *m = b->model;
    if (m->slots) peri__for_points(b, m->points, 2, b->ops->pack, step, NULL);
    if (m->gathers || step->node) {
        peri__for_points(b, m->points, m->width, b->ops->gather, step, NULL);
        if (m->slots) peri__for_points(b, m->points, 1, b->ops->pack_response, step, NULL);
    }
    if (step->node && step->breaking) step->node_most = peri__most_node_energy(step);
    peri__for_points(b, m->points, m->width, b->ops->force, step, sums);
}

/* Energy of the intact bonds; per point to density[points] where it is not NULL. */
static double peri__elastic_energy(peri_body *b, double *density) {
    peri__step step = peri__no_step(b);
    peri__update_lanes(b);
    peri__refresh(b);
    step.out = density;
    peri__for_points(b, b->model->points, 4 * b->model->width, b->ops->energy, &step, b->sums);
    return peri__total(b->sums, b->model->points).a;
}

/* Displacement, velocity or bonds are about to be changed by the caller, not by the equations of motion: the force is stale, and the
   change of energy counts as `initial`. It is measured when next needed, so that a hundred cuts cost two energy passes. */
static void peri__touch(peri_body *b) {
    b->force_current = 0;
    if (!b->desc.ledger || b->ledger.pending) return;
    b->ledger.before = b->steps == 0 && b->ledger.initial == 0.0 ? 0.0 : peri__kinetic_energy(b) + peri__elastic_energy(b, NULL);
    b->ledger.pending = 1;
}

static void peri__settle(peri_body *b) {
    if (!b->ledger.pending) return;
    b->ledger.initial += peri__kinetic_energy(b) + peri__elastic_energy(b, NULL) - b->ledger.before;
    b->ledger.pending = 0;
}

/* What callbacks of loads, supports and obstacles are asked for. */
static double peri__load_time(const peri_body *b) { return b->still ? b->load_factor : b->time; }

static double peri__velocity_unit(const peri__model *m) { return m->length / m->time; }

static double peri__force_unit(const peri__model *m) { return m->stress / m->length; }

/* Displacements and velocities that the arithmetic can square, and cube where stresses are P = F S: within 1e15 spacings, or 1e11; below
   1e9 speeds of sound. */
static int32_t peri__check_state(peri_body *b, const void *array, const double *in, int64_t count, double unit,
                                 const char *field) {
    const int cubes = b->model->gathers & PERI__GRADIENT && b->b32 && b->desc.geometry != PERI_LINEAR;
    const double limit = array == b->v ? 1e9 : cubes ? 1e11 : 1e15;
    for (int64_t k = 0; k < count; ++k)
        if (!(fabs(in[k] / unit) < limit)) return peri__fail(b, PERI_ERROR_RANGE, field, k / b->dim, in[k]);
    return PERI_OK;
}

static int32_t peri__add_to(peri_body *b, void *array, double unit, int32_t set, const double *value) {
    PERI_NEED_VECTOR(b, value);
    int32_t status = peri__check_set(b, set);
    if (status < 0) return status;
    status = peri__check_state(b, array, value, b->dim, unit, "value");
    if (status < 0) return status;
    peri__touch(b);
    for (int64_t k = 0; k < peri__set_count(b, set); ++k)
        for (int32_t d = 0; d < b->dim; ++d) {
            int64_t at = d * b->model->stride + peri__set_point(b, set, k);
            peri__put_real(array, b->f32, at, peri__get_real(array, b->f32, at) + value[d] / unit);
        }
    return PERI_OK;
}

PERI_API int32_t peri_add_displacement(peri_body *b, int32_t set, const double *value) {
    PERI_NEED_IDLE(b);
    return peri__add_to(b, b->u, b->model->length, set, value);
}

PERI_API int32_t peri_add_velocity(peri_body *b, int32_t set, const double *value) {
    PERI_NEED_IDLE(b);
    return peri__add_to(b, b->v, peri__velocity_unit(b->model), set, value);
}
