/* SPDX-License-Identifier: MIT */
/* calibration.c - what the family of a point makes of its state-based law: the constants of peri__constant.

   Under PERI_MOMENTS_LIVE every law is calibrated on the bonds that are left, so a cut crack and a gap between points act alike. The price
   is that few short bonds carry what many did; stiffness.c bounds the frequency that follows. Under PERI_MOMENTS_WHOLE the constants of
   ordinary laws are those of the whole family, for good: a bond that is cut or breaks is in none of the sums over e, and nothing else
   changes. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_SPAN 0.02 /* a shape tensor whose eigenvalues differ by more than this factor counts as singular            */

typedef struct peri__moments { /* sums over the bonds of a family, inner units                                            */
    double m;            /* w |xi|^2 V                                                                                   */
    double length;       /* w |xi| V                                                                                     */
    double plain;        /* w V                                                                                          */
    double shape[6];     /* w xi xi V                                                                                    */
} peri__moments;

static void peri__add_moments(peri__moments *sum, int32_t dim, const double *xi, double bond, double weight) {
    sum->m += weight * bond * bond;
    sum->length += weight * bond;
    sum->plain += weight;
    for (int a = 0; a < dim; ++a)
        for (int c = a; c < dim; ++c) sum->shape[peri__packed(dim, a, c)] += weight * xi[a] * xi[c];
}

/* Is a law calibrated on the live bonds alone? K of a gradient must be that of the bonds it is gathered over. */
PERI_INLINE int peri__counts_live(const peri_body *b, const peri__law *law) {
    return b->desc.moments == PERI_MOMENTS_LIVE || law->gather & PERI__GRADIENT;
}

/* Is m all that the law of all points is calibrated on? */
static int peri__needs_no_more(const peri__model *m) { return !m->mixed && m->gauge && !(m->gathers & PERI__GRADIENT); }

static peri__moments peri__family_moments(const peri_body *b, int64_t i, const peri__row *row, int live) {
    const peri__model *m = b->model;
    peri__moments sum;
    memset(&sum, 0, sizeof sum);
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 }, weight = peri__weight_of(m, i, row->weight, k), bond = peri__get_real(row->bond, b->b32, k);
        if (live && !peri__is_alive(b, i, k)) continue;
        if (peri__needs_no_more(m)) {
            sum.m += weight * bond * bond;
            continue;
        }
        peri__bond_of(m, b->f32, i, row->ids[k], xi);
        peri__add_moments(&sum, m->dim, xi, bond, weight);
    }
    return sum;
}

/* Planes of constants: those of a gradient only where there is one. */
static int32_t peri__constant_planes(const peri__model *m) {
    return m->gathers & PERI__GRADIENT ? PERI__SHAPE_INVERSE + PERI_PACKED(m->dim) : PERI__STABILIZATION;
}

static void peri__put_constant(peri_body *b, int64_t i, int plane, double value) {
    peri__put_real(b->constant, b->b32, b->model->margin + plane * b->model->stride + i, value);
}

PERI_INLINE double peri__get_constant(const peri_body *b, int64_t i, int plane) {
    return peri__get_real(b->constant, b->b32, b->model->margin + plane * b->model->stride + i);
}

typedef struct peri__calibration { /* see peri__constant                                                                 */
    double theta_factor, pressure_factor, spring, stabilization, shape_inverse[6];
} peri__calibration;

/* Strain and stress in double, for fields and the assembled matrix. */
#define peri_s double
#define PERI_S_DIM 3
#define PERI_S_FN(name) peri__##name
#include "gradient.inl"
#undef peri_s
#undef PERI_S_DIM
#undef PERI_S_FN

#define PERI_LAW_ROLE_CALIBRATION
#include "laws.inl"
#undef PERI_LAW_ROLE_CALIBRATION

/* What a law makes of a family, all zero where that has no bonds. 0 where a law with a gradient has a family that spans too little: it acts
   by springs, which are the caller's to give. */
static int peri__calibrate(const peri__law *law, int32_t dim, const peri__moments *sum, peri__calibration *r) {
    memset(r, 0, sizeof *r);
    if (!(sum->m > 0.0)) return 1;
    switch (law->kind) {
#define PERI_CASE(name, number) case number: return peri__calibrate_##name(law, dim, sum, r);
    PERI_LAW_LIST(PERI_CASE)
#undef PERI_CASE
    default: return 1;
    }
}

static void peri__set_constants(peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    peri__law room;
    const peri__law *law = peri__law_at(b, i, &room);
    if (law->pairwise) return;
    peri__calibration r;
    peri__moments sum = peri__family_moments(b, i, row, peri__counts_live(b, law));
    if (!peri__calibrate(law, m->dim, &sum, &r)) r.spring = law->b / peri__family_moments(b, i, row, 0).m;
    peri__put_constant(b, i, PERI__THETA_FACTOR, r.theta_factor);
    peri__put_constant(b, i, PERI__PRESSURE_FACTOR, r.pressure_factor);
    peri__put_constant(b, i, PERI__SPRING, r.spring);
    if (!(m->gathers & PERI__GRADIENT)) return;
    peri__put_constant(b, i, PERI__STABILIZATION, r.stabilization);
    for (int k = 0; k < PERI_PACKED(m->dim); ++k) peri__put_constant(b, i, PERI__SHAPE_INVERSE + k, r.shape_inverse[k]);
}

/* g of bonds at a point of a law, and q of its half of bond (i, j). */
PERI_INLINE double peri__law_gauge(const peri__law *law, double bond) { return law->gauge ? bond : 1.0; }

PERI_INLINE double peri__spring(const peri_body *b, int64_t i, int64_t j, double bond) {
    const peri__model *m = b->model;
    if (m->laws[m->material[i]].pairwise)
        return 0.5 * m->pairs[m->material[i] * m->materials + m->material[j]].c * peri__stiffness_between(b, i, j) / bond;
    return peri__get_constant(b, i, PERI__SPRING);
}
