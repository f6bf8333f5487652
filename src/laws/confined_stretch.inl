/* SPDX-License-Identifier: MIT */
/* confined_stretch.inl - a bond breaks beyond s0 - a least, least the least stretch of the bonds that its ends have: of that end where
   it is higher. So what is pressed sideways bears more (Silling, Askari 2005; s00 and alpha of LAMMPS). */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_confined_stretch = PERI__BY_STRETCH | PERI__AND_MORE | PERI__AND_LEAST, PERI__SHORT_confined_stretch = 0 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
static double peri__limit_confined_stretch(const peri__fracture *g) { return peri__limit_stretch(g); }
#endif

#ifdef PERI_CRITERION_ROLE_OVER
/* s + a least, which goes with the strain. */
PERI_INLINE double PERI_FN(confined)(const peri__operands *s, int64_t i, int64_t j, const PERI_FN(bond) *bond) {
    const double stretch = (double)bond->along / ((double)bond->reach * (double)bond->length);
    if (!s->least) return 0.0;
    return stretch + PERI_FN(pair)(s, i, j)->compression * (s->least[i] > s->least[j] ? s->least[i] : s->least[j]);
}

PERI_INLINE int PERI_FN(over_confined_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                               const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k];
    const double s0 = PERI_FN(pair)(s, i, j)->limit[PERI_CRITERION_CONFINED_STRETCH - peri__first_criterion];
    return bond->along > 0 && PERI_FN(confined)(s, i, j, bond) > s0;
}

PERI_INLINE double PERI_FN(met_confined_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                                 const PERI_FN(bond) *bond) {
    const double s0 = PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_CONFINED_STRETCH - peri__first_criterion];
    const double s1 = PERI_FN(confined)(s, i, row->ids[k], bond);
    return s1 > s0 ? s0 / s1 : 1.0;
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_confined_stretch(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    const int64_t j = row->ids[k];
    const double least = fmax(b->least[i], b->least[j]);
    return (peri__stretch(b, i, row, k) + peri__pair_at(b, i, j)->compression * least) / limit;
}
#endif
