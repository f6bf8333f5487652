/* SPDX-License-Identifier: MIT */
/* rate_stretch.inl - the critical stretch of a bond that lengthens at the rate r = ds/dt is s0 (1 + (r/rate)^power): dynamic strength.
   In equilibria it is s0. */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_rate_stretch = PERI__BY_STRETCH | PERI__AND_MORE, PERI__SHORT_rate_stretch = 0 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
static double peri__limit_rate_stretch(const peri__fracture *g) { return peri__limit_stretch(g); }
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE double PERI_FN(rate_limit)(const peri__operands *s, int64_t i, int64_t j, const PERI_FN(bond) *bond) {
    const peri__pair *pair = PERI_FN(pair)(s, i, j);
    const double s0 = pair->limit[PERI_CRITERION_RATE_STRETCH - peri__first_criterion];
    const double rate = s->step > 0.0 && s0 < PERI_NEVER ? PERI_FN(stretching)(s, i, j, bond) : 0.0;
    return rate > 0.0 ? s0 * (1.0 + pow(rate / (pair->rate * s->model->time), pair->power)) : s0;
}

PERI_INLINE int PERI_FN(over_rate_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    const double s0 = PERI_FN(rate_limit)(s, i, row->ids[k], bond);
    return (double)bond->along > s0 * (double)bond->length * (double)bond->reach;
}

PERI_INLINE double PERI_FN(met_rate_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                             const PERI_FN(bond) *bond) {
    const double s0 = PERI_FN(rate_limit)(s, i, row->ids[k], bond);
    return s0 * (double)bond->length * (double)bond->reach / (double)bond->along;
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_rate_stretch(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    return peri__stretch(b, i, row, k) / limit;
}
#endif
