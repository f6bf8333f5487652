/* SPDX-License-Identifier: MIT */
/* mohr_coulomb.inl - a bond breaks when the plane that it is normal to slips: shear > cohesion - normal stress tan(angle of friction),
   of the mean stress of its ends, tension positive. Shortened bonds break, too. In planes only planes normal to them are looked at.
   Over all directions the most of shear + tan(phi) normal is R/cos(phi) + tan(phi) M, R = (s1 - s3)/2, M = (s1 + s3)/2, on planes
   whose normal is 45 degrees - phi/2 off s1. */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_mohr_coulomb = PERI__BY_STRESS, PERI__SHORT_mohr_coulomb = 1 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
static double peri__limit_mohr_coulomb(const peri__fracture *g) {
    return peri__limit_of_stress(g, g->material->cohesion);
}
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE double PERI_FN(value_mohr_coulomb)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                               const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k];
    if (!s->stress) return 0.0;
    const peri__traction traction = PERI_FN(traction)(s, i, j, bond);
    return (traction.shear + PERI_FN(pair)(s, i, j)->friction * traction.normal) * peri__alignment(s->aligned, i, j, 1);
}

PERI_INLINE int PERI_FN(over_mohr_coulomb)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    return PERI_FN(value_mohr_coulomb)(s, i, row, k, bond)
         > PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_MOHR_COULOMB - peri__first_criterion];
}

PERI_INLINE double PERI_FN(met_mohr_coulomb)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                             const PERI_FN(bond) *bond) {
    const double limit = PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_MOHR_COULOMB - peri__first_criterion];
    const double value = PERI_FN(value_mohr_coulomb)(s, i, row, k, bond);
    return value > limit ? limit / value : 1.0;
}
#endif

#ifdef PERI_CRITERION_ROLE_MOST
static double peri__most_mohr_coulomb(int32_t dim, const double *stress, const peri__pair *pair) {
    double least, largest;
    peri__principal_of(dim, stress, &least, &largest);
    return 0.5 * ((largest - least) * sqrt(1.0 + peri__square(pair->friction)) + (largest + least) * pair->friction);
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_mohr_coulomb(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    const int64_t j = row->ids[k];
    const peri__traction traction = peri__traction_at(b, i, j);
    return (traction.shear + peri__pair_at(b, i, j)->friction * traction.normal) * peri__alignment(b->aligned, i, j, 1) / limit;
}
#endif
