/* SPDX-License-Identifier: MIT */
/* breaking.inl - does a bond meet a criterion, and when within the step does it part: a part of rows.inl. */

/* ---- criteria ------------------------------------------------------------------------------------------------------ */

/* Is bond (i, j) beyond its critical stretch as point j sees it? With centroid bonds the two ends differ; the end of lower id decides for
   both. */
static int PERI_FN(is_over_for_other)(const peri__operands *s, int64_t i, int64_t j, peri_b s0) {
    PERI_FN(bond) bond;
    peri__row row;
    peri__row_of(s->model, j, &row);
    PERI_FN(deform)(s, j, &row, peri__find_bond(s->model, j, i), &bond);
    return bond.along > s0 * bond.length * bond.reach;
}

/* What the mean stress of the ends puts on the plane that the bond is normal to. */
PERI_INLINE peri__traction PERI_FN(traction)(const peri__operands *s, int64_t i, int64_t j, const PERI_FN(bond) *bond) {
    double y[PERI_D];
    for (int d = 0; d < PERI_D; ++d) y[d] = (double)bond->y[d];
    return peri__traction_of(PERI_D, s->stress + i * PERI_D * PERI_D, s->stress + j * PERI_D * PERI_D, y);
}

/* The rate of stretch. */
PERI_INLINE double PERI_FN(stretching)(const peri__operands *s, int64_t i, int64_t j, const PERI_FN(bond) *bond) {
    const int64_t stride = s->model->stride;
    const peri_r *v = (const peri_r *)s->v;
    double rate = 0.0;
    for (int d = 0; d < PERI_D; ++d) rate += (double)bond->y[d] * ((double)v[d * stride + j] - (double)v[d * stride + i]);
    return rate / ((double)bond->now * (double)bond->length + DBL_MIN);
}

#define PERI_CRITERION_ROLE_OVER
#include "../laws/criteria.inl"
#undef PERI_CRITERION_ROLE_OVER

/* Does bond k of row i meet a criterion? The stretch alone, where there are no centroids: */
PERI_INLINE int PERI_FN(is_overstretched)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    return bond->along > (peri_b)PERI_FN(pair)(s, i, row->ids[k])->s0 * bond->length * bond->reach;
}

/* any of them. */
static PERI_APART int PERI_FN(is_over)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k, const PERI_FN(bond) *bond) {
    const uint32_t used = s->model->criteria;
    int over = 0;
#define PERI_CASE(name, number) if (used >> ((number) - peri__first_criterion) & 1) over |= PERI_FN(over_##name)(s, i, row, k, bond);
    PERI_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    return over;
}

/* ---- breaking ------------------------------------------------------------------------------------------------------- */

/* The extension goes from e0 to e, linearly, and meets the criterion at met e: at the part t of the step dt. Until then the bond gives
   dt (t f0 + t^2/2 (f - f0)); the half kick that opened the step has given dt/2 f0 of it; over dt/2 f that leaves (2 t - 1) q + t^2 (1
   - q), q = e0/e: 1 at the end of the step, below 0 in its first half. A bond that is beyond its limit when the step begins breaks
   then. Energies of nodes are not known at the start of the step: of a bond that meets its criterion while it gets shorter the moment
   is the middle. Both ends come to the same numbers, up to centroids. */
static PERI_RARE peri__parting PERI_FN(part)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k,
                                              const PERI_FN(bond) *bond) {
    const int64_t j = row->ids[k], stride = s->model->stride;
    const peri_r *v = (const peri_r *)s->v;
    const double length = (double)bond->length, now = (double)bond->along / (double)bond->reach;
    double along = 0.0, square = 0.0, met = 1.0;
    const peri__parting middle = { 1.0, 0.5, 0.0 };
    peri__parting parting = { 1.0, 1.0, 0.0 };
    if (!s->closing) return parting;
    for (int d = 0; d < PERI_D; ++d) {
        const double apace = (double)v[d * stride + j] - (double)v[d * stride + i];
        const double xi = (double)bond->xi[d], eta = (double)bond->eta[d] - s->step * apace;
        along += (s->linear ? xi : 2.0 * xi + eta) * eta;
        square += (xi + eta) * (xi + eta);
    }
#define PERI_CASE(name, number)                                             \
    if (s->model->criteria >> ((number) - peri__first_criterion) & 1) {     \
        const double at = PERI_FN(met_##name)(s, i, row, k, bond);          \
        if (at < met) met = at;                                             \
    }
    PERI_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    const double eigen = length * (double)PERI_FN(mean_eigenstrain)(s, i, j);
    const double before = along / (s->linear ? length : sqrt(square) + length) - eigen, q = before / now;
    /* the stress of a bond need not go with its extension: where that did not grow from zero, the middle of the step */
    if (s->stress && !(q >= 0.0 && q < 1.0)) return middle;
    double t = now > before || s->stress ? (met * now - before) / (now - before) : 0.5;
    if (!(t > 0.0)) t = 0.0;
    parting.met = q + t * (1.0 - q);
    parting.moment = t;
    parting.share = (2.0 * t - 1.0) * q + t * t * (1.0 - q);
    return parting;
}

static peri__parting PERI_FN(part_of)(const peri__operands *s, int64_t i, const peri__row *row, int64_t k) {
    PERI_FN(bond) bond;
    PERI_FN(deform)(s, i, row, k, &bond);
    return PERI_FN(part)(s, i, row, k, &bond);
}
