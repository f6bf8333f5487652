/* SPDX-License-Identifier: MIT */
/* principal_stress.inl - a stretched bond breaks when the tension on the plane that it is normal to passes the strength (Rankine): the
   mean of the stress of its ends, n.sigma.n. The bond nearest to the direction of the largest principal stress is the first. */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_principal_stress = PERI__BY_STRESS, PERI__SHORT_principal_stress = 0 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
static double peri__limit_principal_stress(const peri__fracture *g) {
    return peri__limit_of_stress(g, g->material->strength);
}
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE double PERI_FN(value_principal_stress)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                                   const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k];
    return s->stress ? PERI_FN(traction)(s, i, j, bond).normal * peri__alignment(s->aligned, i, j, 0) : 0.0;
}

PERI_INLINE int PERI_FN(over_principal_stress)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                               const PERI_FN(bond) *bond) {
    return bond->along > 0 && PERI_FN(value_principal_stress)(s, i, row, k, bond)
         > PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_PRINCIPAL_STRESS - peri__first_criterion];
}

PERI_INLINE double PERI_FN(met_principal_stress)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                                 const PERI_FN(bond) *bond) {
    const double limit = PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_PRINCIPAL_STRESS - peri__first_criterion];
    const double value = PERI_FN(value_principal_stress)(s, i, row, k, bond);
    return value > limit ? limit / value : 1.0;
}
#endif

#ifdef PERI_CRITERION_ROLE_MOST
static double peri__most_principal_stress(int32_t dim, const double *stress, const peri__pair *pair) {
    double least, largest;
    (void)pair;
    peri__principal_of(dim, stress, &least, &largest);
    return largest;
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_principal_stress(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    const int64_t j = row->ids[k];
    return peri__traction_at(b, i, j).normal * peri__alignment(b->aligned, i, j, 0) / limit;
}
#endif
