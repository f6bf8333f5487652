/* SPDX-License-Identifier: MIT */
/* bond_energy.inl - a bond breaks when the work done on it passes w0 V V ([T] 1.100). */
#ifdef PERI_CRITERION_ROLE_TRAITS
enum { PERI__SEEN_bond_energy = PERI__BY_WORK, PERI__SHORT_bond_energy = 0 };
#endif

#ifdef PERI_CRITERION_ROLE_LIMIT
/* w0 such that all bonds across a unit of area take G0: in 3D G0 = w0 int_0^h dz int_z^h 2 pi r^2 (1 - z/r) dr = w0 pi h^4/4. */
static double peri__limit_bond_energy(const peri__fracture *g) {
    if (!(g->energy > 0.0)) return PERI_NEVER;
    return peri__critical_energy(g->material, g->space, g->horizon) / g->unit;
}
#endif

#ifdef PERI_CRITERION_ROLE_OVER
PERI_INLINE int PERI_FN(over_bond_energy)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k];
    if (!s->work || !(bond->along > 0)) return 0;
    const double partial_volume = row->partial_volume ? (double)row->partial_volume[k] : s->model->volume[j];
    return (double)((const peri_r *)s->work)[peri__bond_slot(s->model, i, row, k)]
         > PERI_FN(pair)(s, i, j)->limit[PERI_CRITERION_BOND_ENERGY - peri__first_criterion]
               * peri__square((double)PERI_FN(strength)(s, i, row, k)) * partial_volume;
}

/* Work goes with the square of the extension. */
PERI_INLINE double PERI_FN(met_bond_energy)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                           const PERI_FN(bond) *bond) {
    const double limit = PERI_FN(pair)(s, i, row->ids[k])->limit[PERI_CRITERION_BOND_ENERGY - peri__first_criterion]
                       * peri__square((double)PERI_FN(strength)(s, i, row, k));
    const double partial_volume = row->partial_volume ? (double)row->partial_volume[k] : s->model->volume[row->ids[k]];
    const double work = s->work ? (double)((const peri_r *)s->work)[peri__bond_slot(s->model, i, row, k)] : 0.0;
    (void)bond;
    return work > 0.0 ? sqrt(limit * partial_volume / work) : 1.0;
}
#endif

#ifdef PERI_CRITERION_ROLE_EXCESS
static double peri__excess_bond_energy(const peri_body *b, int64_t i, const peri__row *row, int64_t k, double limit) {
    const double partial_volume = row->partial_volume ? (double)row->partial_volume[k] : b->model->volume[row->ids[k]];
    return peri__get_real(b->work, b->f32, peri__bond_slot(b->model, i, row, k)) / (limit * partial_volume);
}
#endif
