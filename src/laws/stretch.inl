/* SPDX-License-Identifier: MIT */
/* stretch.inl - a bond breaks beyond its critical stretch ([T] 1.39, [P] C.20). */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_stretch = PERI__BY_STRETCH, PERI__SHORT_stretch = 0 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
/* s0^2 = 2 G0/(pi c I4 h^5) in 3D, G0/(c I3 h^4) in the plane: the bonds across a unit of area then take G0. */
static double peri__limit_stretch(const peri__fracture *g) {
    const double h = g->horizon;
    if (g->material->critical_stretch > 0.0) return g->material->critical_stretch;
    if (!(g->energy > 0.0)) return PERI_NEVER;
    return sqrt(g->space == PERI_SPACE_SOLID ? 2.0 * g->energy / (PERI_PI * g->c * g->moment * h * h * h * h * h)
                                       : g->energy / (g->c * g->moment * h * h * h * h));
}
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE int PERI_FN(over_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k];
    const peri_b s0 = (peri_b)PERI_FN(pair)(s, i, j)->limit[PERI_CRITERION_STRETCH - peri__first_criterion];
    if (s->model->centroid && j < i) return PERI_FN(is_over_for_other)(s, i, j, s0);
    if (s->fields) return bond->along > s0 * PERI_FN(strength)(s, i, row, k) * bond->length * bond->reach;
    return bond->along > s0 * bond->length * bond->reach;
}

PERI_INLINE double PERI_FN(met_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    const double s0 = PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_STRETCH - peri__first_criterion];
    return (double)(peri_b)s0 * (double)PERI_FN(strength)(s, i, row, k) * (double)bond->length * (double)bond->reach / (double)bond->along;
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_stretch(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    return peri__elastic_stretch(b, i, row, k) / limit;
}
#endif
