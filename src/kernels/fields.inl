/* SPDX-License-Identifier: MIT */
/* fields.inl - what fields of material are at a point and of a bond: eigenstrain, strength and stiffness, by rows. */
PERI_INLINE peri_b PERI_FN(eigenstrain)(const peri__operands *s, int64_t i) {
    return s->eigenstrain ? ((const peri_b *)s->eigenstrain)[i] : 0;
}

PERI_INLINE peri_b PERI_FN(mean_eigenstrain)(const peri__operands *s, int64_t i, int64_t j) {
    return (peri_b)0.5 * (PERI_FN(eigenstrain)(s, i) + PERI_FN(eigenstrain)(s, j));
}

/* What the strength of bond k of row i is multiplied by. */
PERI_INLINE peri_b PERI_FN(strength)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k) {
    const peri_b *points = (const peri_b *)s->strength;
    const peri_b mean = points ? (peri_b)0.5 * (points[i] + points[row->ids[k]]) : 1;
    return s->bond_strength ? mean * (peri_b)s->bond_strength[peri__bond_slot(s->model, i, row, k)] : mean;
}

/* Stiffness as a factor: of a point, and of a pairwise bond, whose halves act one after the other. */
PERI_INLINE peri_b PERI_FN(stiffness)(const peri__operands *s, int64_t i) {
    return s->stiffness ? ((const peri_b *)s->stiffness)[i] : 1;
}

PERI_INLINE peri_b PERI_FN(stiffness_between)(const peri__operands *s, int64_t i, int64_t j) {
    const peri_b *points = (const peri_b *)s->stiffness;
    return points ? 2 * (points[i] * points[j]) / (points[i] + points[j]) : 1;
}
