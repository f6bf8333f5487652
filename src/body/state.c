/* SPDX-License-Identifier: MIT */
/* state.c - units and places inside, the force of bonds, the energies. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* A field of material from the first point on, or NULL. */
static const void *peri__field_of(const peri_body *b, const void *field) {
    return field ? (const char *)field + (size_t)b->model->margin * peri__bond_real(b) : NULL;
}

/* The fields of material: all, or those alone that the tangent at rest has. Of state-based laws the constants hold the stiffness. */
static void peri__take_fields(const peri_body *b, peri__operands *s, int all) {
    const int by_pairs = b->stiffness && (b->model->pairwise || b->model->mixed);
    s->eigenstrain = all ? peri__field_of(b, b->eigenstrain) : NULL;
    s->strength = all ? peri__field_of(b, b->strength) : NULL;
    s->bond_strength = all ? b->bond_strength : NULL;
    s->stiffness = peri__field_of(b, b->stiffness);
    s->fields = by_pairs || s->eigenstrain || s->strength || s->bond_strength;
}

/* What passes need of a body, with no step, no breaking and no work. */
static peri__operands peri__operands_of(const peri_body *b) {
    const peri__model *m = b->model;
    peri__operands s;
    memset(&s, 0, sizeof s);
    s.model = m;
    s.u = s.drifted = b->u;
    s.v = b->v;
    s.f = b->f;
    s.records = b->records;
    if (b->constant) {
        s.constant = (const char *)b->constant + (size_t)m->margin * peri__bond_real(b);
        s.response = (char *)b->response + (size_t)m->margin * peri__bond_real(b);
    }
    s.alive = b->alive;
    s.dying = b->dying;
    s.masks = b->masks;
    s.point_class = b->point_class;
    s.pairs = b->pairs;
    s.classes = b->classes;
    s.central = b->central;
    s.closing = b->closing;
    s.work = b->work;
    s.pull = b->pull;
    if (b->worked) s.worked = (const char *)b->worked + (size_t)m->margin * peri__real(b);
    s.node = b->node;
    s.bond_laws = b->model->law_of ? b->bond_laws : NULL;
    s.history = b->history;
    s.density = b->density;
    s.least_strength = b->least_strength;
    s.ghost = m->part ? m->part->depth : NULL;
    s.partly = b->desc.moments != PERI_MOMENTS_LIVE && (m->part || b->now.cut + b->now.broken > 0);
    peri__take_fields(b, &s, 1);
    s.linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    return s;
}

/* What the law of bond k of row i makes of its stretch now: the stretch at which a linear bond pulls as hard, and its slope. `bunch` keeps
   the answers for bonds beside it; at first its point is -1, `failed` 0, `asked` what else is wanted. Bonds whose law fails are linear. */
static void peri__ask_bond(const peri_body *b, int64_t i, const peri__row *row, int64_t k, peri__bunch *bunch, double *force,
                           double *tangent) {
    const int64_t first = k - k % PERI_BUNCH;
    if (!b->model->law_of) {
        *force = peri__stretch(b, i, row, k) - peri__felt_eigenstrain(b, i, row->ids[k]);
        *tangent = 1.0;
        return;
    }
    if (bunch->point != i || bunch->first != first) {
        const peri__operands operands = peri__operands_of(b);
        bunch->point = i;
        bunch->first = first;
        bunch->count = (int32_t)peri__min(row->count - first, PERI_BUNCH);
        bunch->asked |= PERI__ASK_TANGENT;
        for (int32_t n = 0; n < bunch->count; ++n) {
            bunch->others[n] = row->ids[first + n];
            bunch->length[n] = peri__get_real(row->bond, b->b32, first + n);
            bunch->stretch[n] = peri__is_alive(b, i, first + n) ? peri__stretch(b, i, row, first + n) : 0.0;
        }
        if (!peri__respond(&operands, i, first, bunch)) {
            peri__follow_none(bunch);
            bunch->failed = 1;
        }
    }
    *force = bunch->force[k - first];
    *tangent = bunch->tangent[k - first];
}

static double peri__kinetic_energy(peri_body *b) {
    peri__operands operands = peri__operands_of(b);
    peri__for_points(b, b->model->points, 1, b->ops->kinetic, &operands, b->sums);
    return peri__total(b->sums, b->model->points).a;
}

/* The largest energy of a node that may lose a bond by it. */
static double peri__most_node_energy(const peri__operands *s) {
    double most = 0.0;
    for (int64_t i = 0; i < s->model->points; ++i)
        if (s->node[i] > most && peri__least_limit(s, i, PERI_CRITERION_NODE_ENERGY) < PERI_NEVER) most = s->node[i];
    return most;
}

/* Notes in the body whether a law of bonds failed in the last pass, for peri__heed_laws. */
static void peri__note_laws(const peri_body *b) {
    const int64_t bad = peri__total(b->sums, b->model->points).bad;
    if (bad >= 0 && b->law_bad < 0) ((peri_body *)b)->law_bad = bad;
}

/* Has a law of bonds, or a stress of the caller, failed since this was last asked? */
static int32_t peri__heed_laws(peri_body *b) {
    const int64_t bad = b->law_bad;
    b->law_bad = -1;
    return bad < 0 ? peri__heed_stress(b) : peri__fail(b, PERI_ERROR_CALLBACK, "peri_bond_law_fn", bad, 0.0);
}

/* Adds the elastic force of all bonds to step->f, by step->u, raw points with the stresses of the caller; b: whose threads do it. */
static void peri__sum_bonds(const peri_body *b, peri__operands *operands, peri__sums *sums) {
    const peri__model *m = b->model;
    if (operands->bond_laws) {
        if (m->record_reals) peri__for_points(b, m->points, 2, b->ops->fill_records, operands, NULL);
        peri__for_points(b, m->points, 2 * m->width, b->ops->law_force, operands, b->sums);
        peri__note_laws(b);
        return;
    }
    if (m->record_reals) peri__for_points(b, m->points, 2, b->ops->fill_records, operands, NULL);
    if (m->gathers || operands->node) {
        peri__for_blocks(b, m->points, m->width, b->ops->gather, operands, NULL, m->part ? m->part->gather_skip : NULL);
        if (operands->past.raw && operands->p) peri__own_changes(b, operands, operands->response);
        else if (operands->past.raw) operands->past.taken = peri__own_stresses(b, operands);
        if (m->record_reals) peri__for_points(b, m->points, 1, b->ops->fill_responses, operands, NULL);
    }
    if (operands->node && operands->breaking) operands->node_most = peri__most_node_energy(operands);
    peri__for_blocks(b, m->points, m->width, b->ops->force, operands, sums, m->part ? m->part->force_skip : NULL);
}

/* The same with all that is not elastic, a time step->step after the history, which takes it where step->past.commit. */
static void peri__sum_forces(peri_body *b, peri__operands *operands, peri__sums *sums) {
    const peri__model *m = b->model;
    double taken = 0.0;
    if (m->inelastic & PERI__FLOWS) taken = peri__make_flow(b, operands->u, operands->step, operands->past.commit, NULL).b;
    operands->past.raw = m->inelastic & PERI__OWN_STRESS ? m->past.raw : NULL;
    peri__sum_bonds(b, operands, sums);
    if (m->inelastic & PERI__FLOWS) peri__add_flow(b, operands->u, operands->f);
    if (operands->past.commit && b->desc.ledger && !b->past.settling) b->now.ledger.damping += taken + operands->past.taken;
}

/* Adds the force of all bonds to f, by the present displacement, and notes or breaks those that meet their criterion; counts the work on
   them where step->working. */
static void peri__bond_forces(peri_body *b, peri__operands *operands) {
    const peri__model *m = b->model;
    peri__sum_forces(b, operands, b->sums);
    if (operands->working) memcpy((char *)b->worked + (size_t)m->margin * peri__real(b),
                                  b->u, (size_t)(m->stride * m->dim) * peri__real(b));
}

/* What inelastic points store over the energy of their elasticity. */
static double peri__inelastic_energy(peri_body *b, const void *u, double *density) {
    double energy = 0.0;
    if (b->model->inelastic & PERI__FLOWS) {
        energy = peri__make_flow(b, u, 0.0, 0, density).a;
        if (u != b->u) (void)peri__make_flow(b, b->u, 0.0, 0, NULL);
    }
    if (b->model->inelastic & PERI__OWN_STRESS) energy += peri__own_energy(b, u, density);
    return energy;
}

/* Energy of the intact bonds under the displacements u, laid out as b->u; per point to density[points] where it is not NULL. */
static double peri__energy_under(peri_body *b, const void *u, double *density) {
    peri__operands operands = peri__operands_of(b);
    peri__update_masks(b);
    peri__refresh(b);
    operands.u = u;
    operands.out = density;
    peri__block_fn energy = operands.bond_laws ? b->ops->law_energy : b->ops->energy;
    peri__for_points(b, b->model->points, 4 * b->model->width, energy, &operands, b->sums);
    if (operands.bond_laws) peri__note_laws(b);
    const double elastic = peri__total(b->sums, b->model->points).a;
    return b->model->inelastic ? elastic + peri__inelastic_energy(b, u, density) : elastic;
}

static double peri__elastic_energy(peri_body *b, double *density) { return peri__energy_under(b, b->u, density); }

/* What callbacks of loads, supports and obstacles are asked for. */
static double peri__load_time(const peri_body *b) { return b->now.still ? b->now.load_factor : b->now.time; }

static double peri__velocity_unit(const peri__model *m) { return m->length / m->time; }

static double peri__force_unit(const peri__model *m) { return m->stress / m->length; }

/* The most that a force density can be, inner units: the precision holds it, and so does a double in the unit of the caller. */
static double peri__most_force(const peri_body *b) {
    const double most = b->f32 ? FLT_MAX : DBL_MAX, unit = peri__force_unit(b->model);
    return unit > 1.0 ? fmin(most, DBL_MAX / unit) : most;
}

/* A place in inner units. */
static void peri__inner(const peri_body *b, const double *place, double *out) {
    for (int32_t d = 0; d < b->dim; ++d) out[d] = (place[d] - b->model->origin[d]) / b->model->length;
}

/* Of u, v or f, without margins. */
static size_t peri__vector_bytes(const peri_body *b) { return (size_t)(b->model->stride * b->model->dim) * peri__real(b); }

/* Memory for displacements that are not those of the body, and for their forces: all of it, which then stays, or none and 0. */
static int peri__need_change(peri_body *b) {
    const peri__model *m = b->model;
    const int64_t vector = peri__vector_reals(m), response = peri__response_reals(m);
    if (b->change_f) return 1;
    void *u = peri__new(&b->memory, vector, peri__real(b)), *r = !m->pairwise ? peri__new(&b->memory, response, peri__bond_real(b)) : NULL;
    if (u && (r || m->pairwise)) b->change_f = peri__new(&b->memory, vector, peri__real(b));
    if (b->change_f) {
        b->change_u = u;
        b->change_response = r;
        return 1;
    }
    peri__delete(&b->memory, u, vector, peri__real(b));
    peri__delete(&b->memory, r, response, peri__bond_real(b));
    return 0;
}
