/* SPDX-License-Identifier: MIT */
/* bonds.c - the bonds of points, row after row of Ibond: who they join, how they weigh, what they give.

   Each bond has an entry at both ends. `force` is what it adds to the force density of the point of the entry, so that rows add up to the
   internal force density; `energy` is its part of the energy density of that point. That is half the work of the point's own half T of the
   force on the way from where the bond is at rest, 1/2 w T.eta V_j, which is the bond's energy where T is linear in the stretches: of a
   bond-based law c w s^2 |xi|/4. What else a point stores (a law with a gradient in nonlinear geometry, stresses of the caller, bonds that
   flow) is dealt out by w |xi|^2 V_j. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__bonds { /* what is read, and of which point                                                          */
    peri_body      *body;
    peri__operands  operands;
    int32_t         attribute;
    double         *density; /* [points] energy density, inner units; NULL where bonds alone tell it                     */
    double          rest;    /* of the point: energy density per w |xi|^2 V_j that is dealt out                          */
    peri__bunch     bunch;
    peri__row       row;
} peri__bonds;

/* f of bond k of row i, inner units. */
static void peri__bond_force(peri__bonds *s, int64_t i, int64_t k, double *force) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    const peri__flow now = { b, b->u, NULL, NULL, 0.0, 0, NULL };
    peri__flow_bond bond;
    double pull = 0.0, slope;
    for (int d = 0; d < m->dim; ++d) force[d] = 0.0;
    if (!peri__is_alive(b, i, k)) return;
    if (m->law_of) {
        peri__ask_bond(b, i, &s->row, k, &s->bunch, &pull, &slope);
        pull *= m->pairs[m->material[i] * m->materials + m->material[s->row.ids[k]]].c * peri__weight_of(m, i, s->row.weight, k);
    } else
        b->ops->bond_force(&s->operands, i, &s->row, k, force);
    if (m->inelastic & PERI__FLOWS) pull -= peri__flow_pull(b, i, &s->row, k, b->past.flow);
    if (pull == 0.0) return;
    peri__flow_deform(&now, i, &s->row, k, &bond);
    for (int d = 0; d < m->dim; ++d) force[d] += pull * bond.along[d];
}

/* What the tensor of point i does on the way of bond k: (Q xi + k eta).(eta - the eigenstrain of i times xi). */
static double peri__tensor_work(const peri__bonds *s, int64_t i, int64_t k) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    const double own = peri__eigenstrain_at(b, i), stabilization = peri__get_constant(b, i, PERI__STABILIZATION);
    double xi[3], eta[3], work = 0.0;
    peri__pull_of(b, i, s->row.ids[k], xi, eta);
    for (int a = 0; a < m->dim; ++a) {
        double t = stabilization * eta[a];
        for (int d = 0; d < m->dim; ++d)
            t += peri__get_real(s->operands.response, b->b32, (1 + a * m->dim + d) * m->stride + i) * xi[d];
        work += t * (eta[a] - own * xi[a]);
    }
    return work;
}

/* Half the work of what point i gives of bond k, times w V_j. */
static double peri__bond_work(peri__bonds *s, int64_t i, int64_t k) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    const int64_t j = s->row.ids[k];
    const double w = peri__weight_of(m, i, s->row.weight, k), length = peri__get_real(s->row.bond, b->b32, k);
    double work, force, slope;
    if (!peri__is_alive(b, i, k)) return 0.0;
    if (m->law_of) {
        peri__ask_bond(b, i, &s->row, k, &s->bunch, &force, &slope);
        return 0.5 * m->pairs[m->material[i] * m->materials + m->material[j]].c * w * length * s->bunch.energy[k % PERI_BUNCH];
    }
    const double e = length * (peri__stretch(b, i, &s->row, k) - peri__felt_eigenstrain(b, i, j));
    work = peri__spring(b, i, j, length) * e * e;
    if (law->gather & PERI__DILATATION) work += peri__get_real(s->operands.response, b->b32, i) * peri__law_gauge(law, length) * e;
    if (law->gather & PERI__GRADIENT) work += peri__tensor_work(s, i, k);
    return 0.5 * w * work;
}

static double peri__bond_square(const peri__bonds *s, int64_t i, int64_t k) {
    const peri_body *b = s->body;
    if (!peri__is_alive(b, i, k)) return 0.0;
    return peri__weight_of(b->model, i, s->row.weight, k) * peri__square(peri__get_real(s->row.bond, b->b32, k));
}

/* What of the energy of point i its bonds do not tell by themselves. */
static void peri__ready_energy(peri__bonds *s, int64_t i) {
    const peri_body *b = s->body;
    double told = 0.0, all = 0.0;
    s->rest = 0.0;
    if (!s->density || !(b->model->laws[b->model->material[i]].gather & PERI__GRADIENT || peri__flowing(b, i))) return;
    for (int64_t k = 0; k < s->row.count; ++k) {
        told += peri__bond_work(s, i, k);
        all += peri__bond_square(s, i, k);
    }
    if (all > 0.0) s->rest = (s->density[i] - told) / all;
}

/* Of bond k of row i to out, units of the caller. */
static void peri__read_bond(peri__bonds *s, int64_t i, int64_t k, double *out) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    switch ((peri_bond)s->attribute) {
    case PERI_BOND_POINT: *out = (double)i; break;
    case PERI_BOND_OTHER: *out = s->row.ids[k]; break;
    case PERI_BOND_LENGTH: *out = peri__get_real(s->row.bond, b->b32, k) * m->length; break;
    case PERI_BOND_VOLUME:
        *out = (s->row.partial_volume ? (double)s->row.partial_volume[k] : m->volume[s->row.ids[k]]) * pow(m->length, m->dim);
        break;
    case PERI_BOND_WEIGHT: *out = peri__weight_of(m, i, s->row.weight, k) * pow(m->length, m->dim); break;
    case PERI_BOND_INTACT: *out = peri__is_alive(b, i, k); break;
    case PERI_BOND_STRETCH: *out = peri__stretch(b, i, &s->row, k); break;
    case PERI_BOND_FORCE:
        peri__bond_force(s, i, k, out);
        for (int d = 0; d < m->dim; ++d) out[d] *= peri__force_unit(m);
        break;
    case PERI_BOND_ENERGY: *out = (peri__bond_work(s, i, k) + s->rest * peri__bond_square(s, i, k)) * m->stress; break;
    }
}

PERI_API int64_t peri_size_of_bonds(const peri_body *b, int32_t set, int32_t bond) {
    PERI_NEED_BODY(b);
    if (!b->model) return peri__fail_const(b, PERI_ERROR_ORDER, "peri_build", -1, 0.0);
    const int32_t at = peri__find_set((peri_body *)b, set);
    int64_t size = 0;
    if (at < 0) return at;
    if (!PERI_IS_ONE_OF(bond, bond)) return peri__fail_const(b, PERI_ERROR_CHOICE, "bond", -1, bond);
    for (int64_t k = 0; k < peri__set_count(b, at); ++k) size += b->model->count[peri__set_point(b, at, k)];
    return bond == PERI_BOND_FORCE ? size * b->dim : size;
}

/* What the attribute is made of, brought up to date. */
static int32_t peri__open_bonds(peri__bonds *s) {
    peri_body *b = s->body;
    const int32_t bond = s->attribute, energy = bond == PERI_BOND_ENERGY;
    if (bond == PERI_BOND_STRETCH && b->model->part) return peri__ensure_force(b);
    if (bond != PERI_BOND_FORCE && !energy) return PERI_OK;
    const int32_t status = peri__ensure_force(b);
    if (status < 0) return status;
    if (b->model->inelastic & PERI__FLOWS) (void)peri__make_flow(b, b->u, 0.0, 0, NULL);
    if (!energy || (!b->model->inelastic && !(b->model->gathers & PERI__GRADIENT))) return PERI_OK;
    s->density = (double *)peri__new(&b->scratch, b->model->points, sizeof(double));
    if (!s->density) return peri__fail(b, PERI_ERROR_MEMORY, "bond", bond, 0.0);
    (void)peri__elastic_energy(b, s->density);
    return PERI_OK;
}

PERI_API int32_t peri_get_bonds(peri_body *b, int32_t set, int32_t bond, double *out, int64_t capacity) {
    peri__bonds s;
    PERI_NEED_BUILT(b);
    const int64_t need = peri_size_of_bonds(b, set, bond);
    if (need < 0) return (int32_t)need;
    PERI_NEED(b, out, "out");
    if (capacity < need) return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)need);
    const int32_t at = peri__find_set(b, set), step = bond == PERI_BOND_FORCE ? b->dim : 1;
    s.body = b;
    s.attribute = bond;
    s.density = NULL;
    int32_t status = peri__open_bonds(&s);
    if (status < 0) return status;
    s.operands = peri__operands_of(b);
    s.bunch.point = -1;
    s.bunch.asked = PERI__ASK_ENERGY;
    s.bunch.failed = 0;
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    for (int64_t n = 0; n < peri__set_count(b, at); ++n) {
        const int64_t i = peri__set_point(b, at, n);
        peri__read_row(b, i, &s.row);
        peri__ready_energy(&s, i);
        for (int64_t k = 0; k < s.row.count; ++k, out += step) peri__read_bond(&s, i, k, out);
        if (s.bunch.failed && b->law_bad < 0) b->law_bad = i;
    }
    peri__leave(b, former);
    peri__delete(&b->scratch, s.density, b->model->points, sizeof(double));
    return peri__heed_laws(b);
}
