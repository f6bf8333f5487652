/* SPDX-License-Identifier: MIT */
/* von_mises.inl - a bond breaks when von Mises's equivalent of the mean stress of its ends passes the strength. That has no direction:
   all bonds of a place break, shortened ones, too. */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_von_mises = PERI__BY_STRESS, PERI__SHORT_von_mises = 1 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
static double peri__limit_von_mises(const peri__fracture *g) {
    return peri__limit_of_stress(g, g->material->strength);
}
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE double PERI_FN(value_von_mises)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                            const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k];
    (void)bond;
    return s->stress ? peri__equivalent_stress(PERI_D, s->stress + i * PERI_D * PERI_D, s->stress + j * PERI_D * PERI_D) : 0.0;
}

PERI_INLINE int PERI_FN(over_von_mises)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    return PERI_FN(value_von_mises)(s, i, row, k, bond)
         > PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_VON_MISES - peri__first_criterion];
}

PERI_INLINE double PERI_FN(met_von_mises)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                          const PERI_FN(bond) *bond) {
    const double limit = PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_VON_MISES - peri__first_criterion];
    const double value = PERI_FN(value_von_mises)(s, i, row, k, bond);
    return value > limit ? limit / value : 1.0;
}
#endif

#ifdef PERI_CRITERION_ROLE_MOST
static double peri__most_von_mises(int32_t dim, const double *stress, const peri__pair *pair) {
    (void)pair;
    return peri__equivalent_stress(dim, stress, stress);
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_von_mises(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    const int64_t size = b->dim * b->dim;
    return peri__equivalent_stress(b->dim, b->stress + i * size, b->stress + row->ids[k] * size) / limit;
}
#endif
