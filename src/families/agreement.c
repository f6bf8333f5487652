/* SPDX-License-Identifier: MIT */
/* agreement.c - do families of the caller belong to the horizon that the constants are for?

   The stiffness of a point is sum w |xi| V over its family, and the constants hold for the family that the horizon gives. Both sums are
   taken over the same points, so that surfaces, coarse lattices and clouds cancel. Their ratio alone does not decide: a family that a face
   or a notch cuts off misses as much as one of half the horizon. But what a face cuts off begins near the point, where other bonds go on to
   the horizon; what a smaller horizon leaves out is all farther away than what it takes. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_AGREES 0.8    /* ratios from this to its inverse agree                                                       */
#define PERI_CUT_SHORT 0.8 /* nearest point left out over the longest bond: more where a shorter horizon cut the family   */

typedef struct peri__agreement { /* of the family of a point                                                              */
    double  given, sought; /* sum w |xi| V of the caller's family; of that within the horizon                            */
    double  longest;       /* bond of both                                                                               */
    double  missed;        /* the nearest point within the horizon that is not in the caller's family                    */
    int64_t count;         /* points within the horizon                                                                  */
} peri__agreement;

static double peri__stiff_of(const peri__cloud *c, int64_t j, double bond) {
    const double w = fabs(peri__influence(c->body, bond / c->model->horizon, c->edge));
    return peri__finite(w) ? w * bond * c->model->volume[j] : 0.0;
}

/* Cells of which only a part is within the horizon may be in the family or not: those whose centre is beyond it count nowhere. */
static peri__agreement peri__agreement_of(const peri__cloud *c, int64_t i, peri__near *s) {
    const peri__model *m = c->model;
    const int64_t cell = peri__cell_of(c, &c->x[i * m->dim]);
    const double horizon = m->horizon * (1.0 + PERI_HORIZON_TOLERANCE);
    peri__agreement a = { 0.0, 0.0, 0.0, HUGE_VAL, 0 };
    int32_t own = c->start[cell];
    for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at) {
        double xi[3], bond;
        peri__bond_vector(c, i, m->ids[at], xi);
        bond = sqrt(peri__dot(xi, xi, m->dim));
        if (bond <= horizon) a.given += peri__stiff_of(c, m->ids[at], bond);
        else if (bond * bond > c->reach2 || !peri__is_family(c, i, m->ids[at]))
            a.given += fabs(peri__weight_of(m, i, m->weight, at)) * bond;
    }
    while (c->order[own] != i) ++own;
    peri__look_around(c, cell, s);
    while (peri__next_near(s) > 0) {
        const int64_t taken = peri__take_near(c, s, &c->x[i * m->dim], own);
        for (int64_t k = 0; k < taken; ++k) {
            const double bond = sqrt(s->length[k]);
            double *end = peri__find_listed(m, i, c->order[s->hit[k]]) < 0 ? &a.missed : &a.longest;
            if (bond > horizon) continue;
            a.count++;
            a.sought += peri__stiff_of(c, c->order[s->hit[k]], bond);
            if (end == &a.missed ? bond < *end : bond > *end) *end = bond;
        }
    }
    return a;
}

/* Refuses families of the caller that the horizon would not give, over the body as a whole. A body within one horizon has no bulk, and its
   bonds are what the caller says. */
static int32_t peri__check_agreement(peri_body *b, peri__cloud *c) {
    const peri__model *m = c->model;
    double given = 0.0, sought = 0.0, ratio[2] = { 1.0, 1.0 };
    int64_t first[2] = { -1, -1 }, fewer = 0, shorter = 0, most = 0;
    peri__near s;
    peri__set_reach(c);
    if (peri__sort_cells(c) < 0) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    for (int64_t i = 0; i < m->points; ++i) {
        const peri__agreement a = peri__agreement_of(c, i, &s);
        const int few = a.given < PERI_AGREES * a.sought, many = PERI_AGREES * a.given > a.sought;
        const int cut_short = few && a.missed > PERI_CUT_SHORT * a.longest;
        given += a.given;
        sought += a.sought;
        fewer += few;
        shorter += cut_short;
        if (a.count > most) most = a.count;
        if ((!many && !cut_short) || first[many] >= 0) continue;
        first[many] = i;
        ratio[many] = a.sought > 0.0 ? a.given / a.sought : HUGE_VAL;
    }
    const int many = PERI_AGREES * given > sought;
    if (most + 1 == m->points || (!many && !(given < PERI_AGREES * sought && 2 * shorter > fewer))) return PERI_OK;
    return peri__fail(b, PERI_ERROR_IBOND, "ibond", first[many], ratio[many]);
}
