/* SPDX-License-Identifier: MIT */
/* strength.c - what criteria of stress, and of the least stretch, ask of points: kept in the body, up to date where bonds may break.

   The stress is that of PERI_FIELD_STRESS: of the material, at the displacement gradient H = (sum w eta xi V) K^-1 of the live family. The
   sum is done by vectors; K^-1 is kept, and made anew where the bonds of a point are others than when it was. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_CRITERION_ROLE_MOST
#include "../laws/criteria.inl"
#undef PERI_CRITERION_ROLE_MOST

/* The most that a bond of point i can have of a criterion of stress, over the limit of the bond. */
static double peri__nearness_of(const peri_body *b, int64_t i) {
    const peri__pair *pairs = b->point_class ? &b->pairs[b->point_class[i] * b->classes] : b->pairs;
    const double *stress = &b->stress[i * b->dim * b->dim];
    double most = 0.0;
    for (int32_t k = 0; k < (b->point_class ? b->classes : 1); ++k) {
#define PERI_CASE(name, number)                                                                                        \
    if (pairs[k].limit[(number) - peri__first_criterion] < PERI_NEVER)                                                 \
        most = fmax(most, peri__most_##name(b->dim, stress, &pairs[k]) / pairs[k].limit[(number) - peri__first_criterion]);
        PERI_STRESS_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    }
    return most;
}

/* K^-1 of point i, where its bonds are others than when that was made. */
static void peri__renew_inverse(peri_body *b, int64_t i, double *inverse) {
    const peri__model *m = b->model;
    const size_t bytes = (size_t)m->words * sizeof *b->alive;
    double shape[6] = { 0.0 };
    peri__row row;
    if (memcmp(&b->inverse_alive[i * m->words], &b->alive[i * m->words], bytes) == 0) return;
    memcpy(&b->inverse_alive[i * m->words], &b->alive[i * m->words], bytes);
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        double xi[3], eta[3];
        const double w = peri__weight_of(m, i, row.weight, k);
        if (!peri__is_alive(b, i, k)) continue;
        peri__pull_of(b, i, row.ids[k], xi, eta);
        for (int a = 0; a < m->dim; ++a)
            for (int c = a; c < m->dim; ++c) shape[peri__packed(m->dim, a, c)] += w * xi[a] * xi[c];
    }
    inverse[PERI_PACKED(m->dim)] = peri__invert(m->dim, shape, PERI_SPAN, inverse) == m->dim;
}

/* The stress of point i, of the sum of w eta xi V in its place. In plane strain that across the plane is as Hooke's law has it. */
static void peri__note_point_stress(peri_body *b, int64_t i, peri__sums *sums) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    const int32_t dim = m->dim;
    double *inverse = &b->inverse[i * (PERI_PACKED(dim) + 1)], *stress = &b->stress[i * dim * dim], p[3][3];
    peri__deformation f;
    peri__renew_inverse(b, i, inverse);
    if (inverse[PERI_PACKED(dim)] > 0.0) {
        f.whole = 1;
        for (int a = 0; a < dim; ++a)
            for (int c = 0; c < dim; ++c) {
                f.h[a][c] = 0.0;
                for (int d = 0; d < dim; ++d) f.h[a][c] += stress[a * dim + d] * inverse[peri__packed(dim, d, c)];
            }
    } else {
        peri__row row;
        peri__read_row(b, i, &row);
        peri__deform(b, i, &row, &f);
    }
    peri__piola(b, i, &f, p, sums);
    peri__cauchy(b, p, &f, stress);
    if (dim == 2)
        stress[3] = b->desc.space == PERI_SPACE_PLANE_STRESS ? 0.0 : 0.5 * law->lambda / (law->lambda + law->mu) * (stress[0] + stress[1]);
}

/* What a criterion has of the worst plane, `most`, over what the plane of the best bond has. */
static double peri__misfit(double most, double best) {
    if (!(most > 0.0) || best >= most) return 1.0;
    return 2.0 * best > most ? most / best : 2.0;
}

/* Of all bonds of point i, broken ones, too: what is left of a family at a crack still knows its directions. */
static void peri__align(peri_body *b, int64_t i) {
    const int32_t dim = b->dim, linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    const peri__pair *pair = peri__pair_at(b, i, i);
    const double *stress = &b->stress[i * dim * dim];
    double normal = 0.0, slip = 0.0;
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        double xi[3], y[3];
        peri__pull_of(b, i, row.ids[k], xi, y);
        for (int32_t d = 0; d < dim; ++d) y[d] = xi[d] + (linear ? 0.0 : y[d]);
        const peri__traction traction = peri__traction_of(dim, stress, stress, y);
        normal = fmax(normal, traction.normal);
        slip = fmax(slip, traction.shear + pair->friction * traction.normal);
    }
    b->aligned[i * PERI_ALIGNED] = peri__misfit(peri__most_principal_stress(dim, stress, pair), normal);
    b->aligned[i * PERI_ALIGNED + 1] = peri__misfit(peri__most_mohr_coulomb(dim, stress, pair), slip);
}

typedef struct peri__aligning {
    peri_body *body;
    double     least; /* nearness of the points that it is for                                                           */
} peri__aligning;

static void peri__align_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__aligning *a = (const peri__aligning *)context;
    (void)sums;
    for (int64_t i = begin; i < end; ++i)
        if (a->body->nearness[i] >= a->least) peri__align(a->body, i);
        else a->body->aligned[i * PERI_ALIGNED] = a->body->aligned[i * PERI_ALIGNED + 1] = 1.0;
}

/* sums->a: the largest nearness; bad, n: as of peri__own_piola. */
static void peri__stress_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri_body *b = (peri_body *)context;
    for (int64_t i = begin; i < end; ++i) {
        peri__note_point_stress(b, i, sums);
        b->nearness[i] = peri__nearness_of(b, i);
        sums->a = fmax(sums->a, b->nearness[i]);
    }
}

/* What criteria ask of points at the present displacement; to *operands, too, which may be NULL. */
static void peri__note_stresses(peri_body *b, peri__operands *operands) {
    const peri__model *m = b->model;
    peri__operands o = peri__operands_of(b);
    if (!(m->seen_by & (PERI__BY_STRESS | PERI__AND_LEAST | PERI__AND_PAST))) return;
    peri__update_masks(b);
    o.stress = b->stress;
    o.least = b->least;
    if (m->record_reals && m->seen_by & (PERI__BY_STRESS | PERI__AND_LEAST))
        peri__for_points(b, m->points, 2, b->ops->fill_records, &o, NULL);
    if (m->seen_by & PERI__AND_LEAST) peri__for_points(b, m->points, 2 * m->width, b->ops->gather_least, &o, NULL);
    if (m->seen_by & PERI__BY_STRESS) {
        peri__for_points(b, m->points, m->width, b->ops->gather_shapes, &o, NULL);
        peri__for_points(b, m->points, m->width, peri__stress_block, b, b->sums);
        for (int64_t k = 0; k < m->blocks; ++k) o.nearness_most = fmax(o.nearness_most, b->sums[k].a);
        peri__note_failures(b);
        /* in motion of those points alone that can have a bond over its limit: 0.5 (nearness + most) > 1 */
        peri__aligning aligning = { b, operands ? 2.0 * (1.0 - 1e-6) - o.nearness_most : -HUGE_VAL };
        if (!operands || o.nearness_most >= aligning.least)
            peri__for_points(b, m->points, 2 * m->width, peri__align_block, &aligning, NULL);
    }
    if (!operands) return;
    operands->stress = b->stress;
    operands->nearness = b->nearness;
    operands->nearness_most = o.nearness_most;
    operands->aligned = b->aligned;
    operands->least = b->least;
    operands->overtime = b->overtime;
}
