/* SPDX-License-Identifier: MIT */
/* delayed_stretch.inl - a bond breaks when it has been over its critical stretch for some time, in all: cracks take time to grow
   (Tuler, Butcher 1968, with the exponent 0). An equilibrium lasts for ever. */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_delayed_stretch = PERI__BY_STRETCH | PERI__AND_MORE | PERI__AND_PAST, PERI__SHORT_delayed_stretch = 0 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
static double peri__limit_delayed_stretch(const peri__fracture *g) { return peri__limit_stretch(g); }
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE int PERI_FN(over_delayed_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                              const PERI_FN(bond) *bond) {
    const peri__pair *pair = PERI_FN(pair)(s, i, row->ids[k]);
    const double s0 = pair->limit[PERI_CRITERION_DELAYED_STRETCH - peri__first_criterion];
    const double over = (double)bond->along / ((double)bond->length * (double)bond->reach) - s0;
    if (!s->overtime || !(over > 0.0)) return 0;
    const double way = s->step > 0.0 ? s->step * PERI_FN(stretching)(s, i, row->ids[k], bond) : 0.0;
    double *over_for = &s->overtime[peri__bond_slot(s->model, i, row, k)];
    *over_for += s->step * s->model->time * (way > over ? over / way : 1.0); /* what of the step it was over */
    return *over_for > pair->delay;
}

PERI_INLINE double PERI_FN(met_delayed_stretch)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                                const PERI_FN(bond) *bond) {
    const peri__pair *pair = PERI_FN(pair)(s, i, row->ids[k]);
    const double s0 = pair->limit[PERI_CRITERION_DELAYED_STRETCH - peri__first_criterion];
    const double stretch = (double)bond->along / ((double)bond->length * (double)bond->reach);
    if (!s->overtime || !(s->step > 0.0) || !(stretch > s0)) return 1.0;
    const double late = s->overtime[peri__bond_slot(s->model, i, row, k)] - pair->delay;
    return 1.0 - late / s->model->time * PERI_FN(stretching)(s, i, row->ids[k], bond) / stretch;
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_delayed_stretch(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    return peri__stretch(b, i, row, k) / limit;
}
#endif
