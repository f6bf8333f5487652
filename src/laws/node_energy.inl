/* SPDX-License-Identifier: MIT */
/* node_energy.inl - a bond breaks when the mean energy of its ends, 2 W over the volume of the family, passes w0 ([T] 1.102). */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_node_energy = PERI__BY_NODE_ENERGY, PERI__SHORT_node_energy = 0 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
static double peri__limit_node_energy(const peri__fracture *g) {
    if (!(g->energy > 0.0)) return PERI_NEVER;
    return peri__critical_energy(g->material, g->space, g->horizon) / g->unit / peri__node_share(g->space, g->across, g->live);
}
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE int PERI_FN(over_node_energy)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k];
    const int at = PERI_CRITERION_NODE_ENERGY - peri__first_criterion;
    return s->node && bond->along > 0
        && 0.5 * (s->node[i] + s->node[j]) > PERI_FN(pair)(s, i, j)->limit[at] * peri__square((double)PERI_FN(strength)(s, i, row, k));
}

PERI_INLINE double PERI_FN(met_node_energy)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                           const PERI_FN(bond) *bond) {
    const double limit = PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_NODE_ENERGY - peri__first_criterion]
                       * peri__square((double)PERI_FN(strength)(s, i, row, k));
    const double energy = s->node ? 0.5 * (s->node[i] + s->node[row->ids[k]]) : 0.0;
    (void)bond;
    return energy > 0.0 ? sqrt(limit / energy) : 1.0;
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_node_energy(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    return 0.5 * (b->node[i] + b->node[row->ids[k]]) / limit;
}
#endif
