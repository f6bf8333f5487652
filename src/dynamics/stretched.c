/* SPDX-License-Identifier: MIT */
/* stretched.c - how much stiffer than at rest a body is made by its deformation; the stable step follows.

   Nonlinear geometry only. A bond that is f times as long as at rest has the tangent M M + (1 - 1/f) (1 - M M) times that of a spring:
   stretched, it resists across its length, too; squeezed, its length turns away from the direction of the squeeze, and those of its family
   gather across. Under affine deformation of lattices of 30 x 30 and 9^3 points (each law, nu = 0.2 and 0.45; one, two and three axes
   stretched to 1.4 or squeezed to 0.5, and both together) the largest eigenvalue of the ordinary laws stays below

       1 + (D - 1)/2 (f - 1) + (1 - g)/2        f, g: most and least length of a bond over that at rest, f >= 1 >= g

   times that at rest; that of P = F S, as d(F S) = dF S + F C:(F^T dF) says, below f^2 + D/2 (f^2 - 1). Random displacements, whose
   bonds turn every way, add next to nothing.

   The shortest bonds of each point are looked at, which see the largest differences: by who asks after a change, and now and then in a
   run. Ordinary bodies have room in the default safety for strains of a third between two looks. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_LOOK       32   /* steps between two looks                                                                    */
#define PERI_LOOK_OFTEN 8    /* where P = F S                                                                              */
#define PERI_SHORT      1.5  /* times the shortest bond of a point, and it is looked at                                    */
#define PERI_NO_STIFFER 1.05 /* the margin of the estimate has room for that, and small strains leave the step alone        */

typedef struct peri__reach { /* squares of lengths over those at rest                                                    */
    double most, least;
} peri__reach;

PERI_INLINE void peri__reach_of(peri__reach *reach, double square) {
    if (square > reach->most) reach->most = square;
    if (square < reach->least) reach->least = square;
}

/* Bonds of group g on columns, each once. */
static void peri__group_reach(const peri_body *b, int64_t g, peri__reach *reach) {
    const peri__model *m = b->model;
    const peri__stencil *l = &m->stencil;
    const peri__column *column = &l->column[l->first[g]];
    double shortest = HUGE_VAL;
    for (int64_t c = 0; c < l->begin[g + 1] - l->begin[g]; ++c)
        if (l->table[column[c].vector].length < shortest) shortest = l->table[column[c].vector].length;
    for (int64_t c = 0; c < l->begin[g + 1] - l->begin[g]; ++c) {
        const peri__stencil_bond *bond = &l->table[column[c].vector];
        const uint32_t live = b->masks ? b->masks[l->begin[g] + c] : column[c].member;
        if (column[c].offset < 0 || bond->length > PERI_SHORT * shortest) continue;
        for (int64_t n = 0; n < PERI_GROUP; ++n) {
            const int64_t i = g * PERI_GROUP + n, j = i + column[c].offset;
            double square = 0.0;
            if (!(live >> n & 1) || peri__is_ghost(m, i)) continue;
            for (int32_t d = 0; d < m->dim; ++d)
                square += peri__square(bond->xi[d] + peri__get_real(b->u, b->f32, d * m->stride + j)
                                       - peri__get_real(b->u, b->f32, d * m->stride + i));
            peri__reach_of(reach, square / peri__square(bond->length));
        }
    }
}

static void peri__row_reach(const peri_body *b, int64_t i, peri__reach *reach) {
    peri__row row;
    double shortest = HUGE_VAL;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        const double length = peri__get_real(row.bond, b->b32, k);
        if (length < shortest) shortest = length;
    }
    for (int64_t k = 0; k < row.count; ++k) {
        if (peri__get_real(row.bond, b->b32, k) > PERI_SHORT * shortest || !peri__is_alive(b, i, k)) continue;
        peri__reach_of(reach, peri__square(1.0 + peri__stretch(b, i, &row, k)));
    }
}

static void peri__reach_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = (const peri_body *)context;
    peri__reach reach = { 1.0, 1.0 };
    if (b->model->stencil.columns > 0)
        for (int64_t g = begin / PERI_GROUP; g * PERI_GROUP < end; ++g) peri__group_reach(b, g, &reach);
    else
        for (int64_t i = begin; i < end; ++i)
            if (!peri__is_ghost(b->model, i)) peri__row_reach(b, i, &reach);
    sums->a = reach.most;
    sums->b = reach.least;
}

/* now.stiffer, from the displacement as it is: in eighths, so that the step does not change with every look. */
static void peri__look_at_stretch(peri_body *b) {
    const peri__model *m = b->model;
    double most = 1.0, least = 1.0, stiffer;
    b->now.stale &= ~(uint32_t)PERI__STALE_STRETCH;
    b->now.stiffer = 1.0;
    if (b->desc.geometry == PERI_GEOMETRY_LINEAR || m->centroid) return;
    peri__update_masks(b);
    peri__for_points(b, m->points, 4, peri__reach_block, b, b->sums);
    for (int64_t k = 0; k < m->blocks; ++k) {
        if (b->sums[k].a > most) most = b->sums[k].a;
        if (b->sums[k].b < least) least = b->sums[k].b;
    }
    if (m->gathers & PERI__GRADIENT) stiffer = most + 0.5 * m->dim * (most - 1.0);
    else stiffer = 1.0 + 0.5 * (m->dim - 1) * (sqrt(most) - 1.0) + 0.5 * (1.0 - sqrt(least));
    if (stiffer > PERI_NO_STIFFER) b->now.stiffer = ceil(8.0 * stiffer) / 8.0;
}

static void peri__look_in_time(peri_body *b) {
    if (b->now.steps % (b->model->gathers & PERI__GRADIENT ? PERI_LOOK_OFTEN : PERI_LOOK) == 0) peri__look_at_stretch(b);
}
