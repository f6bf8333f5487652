/* SPDX-License-Identifier: MIT */
/* weights.c - the lengths and weights of bonds, and the bound of the highest frequency. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_BLUR 1e-3

/* The centroid rule made objective: beta_ij w |centroid bond|/|bond|, w at the centroid of the part of j within the horizon of i. */
static double peri__moment_weight(const peri__cloud *c, int64_t i, int64_t j, double bond, double edge) {
    double centre[3], beta = peri__partial_volume(c, i, j, centre), length = sqrt(peri__dot(centre, centre, c->model->dim));
    return beta * peri__influence(c->body, length / c->model->horizon, edge) * length / bond;
}

/* sum of beta V_j over the whole family of a point. */
PERI_SHARED double peri__family_volume(const peri__model *m, int64_t i) {
    double sum = 0.0;
    const peri__stencil *l = &m->stencil;
    for (int64_t c = 0; l->columns && c < l->begin[i / PERI_GROUP + 1] - l->begin[i / PERI_GROUP]; ++c) {
        const peri__column *column = &l->column[l->first[i / PERI_GROUP] + c];
        if (column->member >> (i % PERI_GROUP) & 1)
            sum += l->partial ? (double)(float)l->table[column->vector].partial_volume : m->volume[i + column->offset];
    }
    for (int64_t k = 0; !l->columns && k < m->count[i]; ++k)
        sum += m->partial_volume ? (double)m->partial_volume[m->start[i] + k] : m->volume[peri__entry_id(m, m->start[i] + k)];
    return sum;
}

typedef struct peri__bond { /* what is known of a bond (i, j), inner units                                                */
    double xi[3], length; /* x_j - x_i; its length, or that of the bond to the centroid                                  */
    double weight, partial_volume; /* w beta V_j, beta V_j                                                               */
    double centre[3];     /* with the centroid rule: bond to the centroid                                                */
} peri__bond;

static void peri__bond_vector(const peri__cloud *c, int64_t i, int64_t j, double *xi) {
    for (int32_t d = 0; d < c->model->dim; ++d) xi[d] = c->x[j * c->model->dim + d] - c->x[i * c->model->dim + d];
}

/* |xi| of entry `at` of the list, bond (i, j); or of the bond to the centroid. */
static double peri__listed_length(const peri__cloud *c, int64_t i, int64_t at) {
    double xi[3];
    if (c->model->bond) return peri__get_real(c->model->bond, c->body->b32, at);
    peri__bond_vector(c, i, peri__entry_id(c->model, at), xi);
    return sqrt(peri__dot(xi, xi, c->model->dim));
}

/* 0 where the influence function is not finite. */
static int peri__weigh_bond(const peri__cloud *c, peri__partial_volumes *parts, int64_t i, int64_t j, peri__bond *bond) {
    const peri__model *m = c->model;
    const peri_body_desc *desc = &c->body->desc;
    double square = 0.0, beta, w, length;
    peri__bond_vector(c, i, j, bond->xi);
    for (int32_t d = 0; d < m->dim; ++d) square += bond->xi[d] * bond->xi[d];
    bond->length = length = sqrt(square);
    beta = peri__beta(c, parts, i, j);
    if (desc->quadrature == PERI_QUADRATURE_PARTIAL_CENTROID) {
        (void)peri__partial_volume(c, i, j, bond->centre);
        bond->length = sqrt(peri__dot(bond->centre, bond->centre, m->dim));
    }
    if (desc->quadrature == PERI_QUADRATURE_PARTIAL_MOMENT)
        w = 0.5 * (peri__moment_weight(c, i, j, length, c->edge) + peri__moment_weight(c, j, i, length, c->edge));
    else
        w = beta * peri__influence(c->body, bond->length / m->horizon, c->edge);
    bond->weight = w * (m->mutual ? m->volume[i] * m->volume[j] : m->volume[j]);
    bond->partial_volume = beta * m->volume[j];
    return peri__finite(w);
}

/* Is the length of bond (i, j) lost in the rounding of the places of its ends? Only in single precision, of points very near each other:
   so near that fourth powers of the length are out of range, too. */
static int peri__is_blurred(const peri__cloud *c, int64_t i, int64_t j, double length) {
    const peri__model *m = c->model;
    double square = 0.0;
    if (!c->body->b32) return 0;
    for (int32_t d = 0; d < m->dim; ++d)
        square += peri__square(peri__get_real(m->x, c->body->f32, d * m->stride + j)
                               - peri__get_real(m->x, c->body->f32, d * m->stride + i));
    return length < PERI_BLUR || fabs(sqrt(square) - length) > PERI_BLUR * length;
}

/* Is the bond itself lost in that rounding, a tenth of it or more? Both ends are rounded by up to 2^-24 of the extent per axis: only
   bonds shorter than PERI_LOSABLE extents can be. */
#define PERI_LOSABLE (20.0 * FLT_EPSILON)
static int peri__is_lost(const peri__cloud *c, int64_t i, int64_t j) {
    const peri__model *m = c->model;
    double xi[3], off = 0.0;
    if (!c->body->f32 || m->centroid) return 0;
    peri__bond_vector(c, i, j, xi);
    for (int32_t d = 0; d < m->dim; ++d)
        off += peri__square(peri__get_real(m->x, 1, d * m->stride + j) - peri__get_real(m->x, 1, d * m->stride + i) - xi[d]);
    return off > 0.01 * peri__dot(xi, xi, m->dim);
}

/* PERI_OK, or why nothing can be reckoned with a family of this sum of |w V| and of w |xi|^2 V: cubes of the sum, as in the determinant of
   K, and what it divides must be in the range of bonds. */
static int32_t peri__check_weight(const peri_body *b, double total, double stiff, int springs) {
    const double most = b->b32 ? 1e32 : 1e100;
    if (!(total > 0.0)) return PERI_ERROR_FAMILY;
    return total < most && total > 1.0 / most && (springs || stiff > 0.0) ? PERI_OK : PERI_ERROR_INFLUENCE;
}

/* Weights of a block of rows, in the order of places. sums->bad: the least id of a row that is refused, sums->n: its status; sums->a:
   blurred bonds. */
static void peri__weigh_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri__cloud *c = (peri__cloud *)context;
    const peri_body *b = c->body;
    peri__model *m = c->model;
    peri__bond bond;
    peri__partial_volumes parts;
    peri__clear_partial_volumes(&parts);
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        double total = 0.0, stiff = 0.0;
        int32_t status = PERI_OK;
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i] && status == PERI_OK; ++at) {
            const int64_t j = peri__entry_id(m, at);
            int finite = peri__weigh_bond(c, &parts, i, j, &bond);
            peri__put_real(m->weight, b->b32, at, bond.weight);
            if (!finite || !peri__finite(peri__get_real(m->weight, b->b32, at))) status = PERI_ERROR_INFLUENCE; /* or beyond float */
            if (m->bond) peri__put_real(m->bond, b->b32, at, bond.length);
            if (m->partial_volume) m->partial_volume[at] = (float)bond.partial_volume;
            for (int32_t d = 0; m->centroid && d < m->dim; ++d) peri__put_real(m->centroid, b->b32, at * m->dim + d, bond.centre[d]);
            sums->a += peri__is_blurred(c, i, j, bond.length);
            if (status == PERI_OK && peri__is_lost(c, i, j)) status = PERI_ERROR_COINCIDENT;
            total += fabs(bond.weight);
            stiff += bond.weight * bond.length * bond.length;
        }
        total /= peri__share(m, i);
        stiff /= peri__share(m, i);
        if (status == PERI_OK) status = peri__check_weight(b, total, stiff, m->laws[m->material[i]].pairwise);
        if (status == PERI_OK || (sums->bad >= 0 && sums->bad < i)) continue;
        sums->bad = i;
        sums->n = status;
    }
}

/* ---- weights of whole cells, of the hits of a search ------------------------------------------------------------- */

typedef struct peri__tally { /* of a row so far                                                                           */
    int64_t count, blurred;
    double  total, stiff, row_sum; /* sums of |w V|, w |xi|^2 V and c |w V|/|xi|                                         */
} peri__tally;

#define PERI_TALLY_LANES 8

/* Squares of lengths to lengths. count is a multiple of PERI_TALLY_LANES. Roots as in kernels.inl. */
#define PERI_ROOTS(isa, target, width, load, store, root)                                                              \
    target static void peri__roots_##isa(double *length, int64_t count) {                                              \
        for (int64_t k = 0; k < count; k += width) store(length + k, root(load(length + k)));                          \
    }
/* The sums of a tally over bonds: bond k in lane k % PERI_TALLY_LANES, so the same bits from every instruction set. */
#define PERI_TALLY(isa, target)                                                                                        \
    target static void peri__tally_##isa(const double *length, const double *weight, int64_t count, double (*sum)[PERI_TALLY_LANES]) { \
        PERI_NO_CONTRACTION                                                                                            \
        peri__double8 total = { 0.0 }, stiff = { 0.0 }, row_sum = { 0.0 };                                                \
        for (int64_t k = 0; k < count; k += PERI_TALLY_LANES) {                                                        \
            peri__double8 w, bond;                                                                                     \
            memcpy(&w, weight + k, sizeof w);                                                                          \
            memcpy(&bond, length + k, sizeof bond);                                                                    \
            const peri__double8 size = (peri__double8)((peri__long8)w & INT64_MAX); /* |w| */                          \
            total += size;                                                                                             \
            stiff += w * bond * bond;                                                                                  \
            row_sum += size / bond;                                                                                       \
        }                                                                                                              \
        memcpy(sum[0], &total, sizeof total);                                                                          \
        memcpy(sum[1], &stiff, sizeof stiff);                                                                          \
        memcpy(sum[2], &row_sum, sizeof row_sum);                                                                            \
    }
#ifdef PERI_ISA
typedef double  peri__double8 __attribute__((vector_size(64)));
typedef int64_t peri__long8 __attribute__((vector_size(64)));
PERI_ROOTS(plain, PERI_VECTOR_CODE, 2, _mm_loadu_pd, _mm_storeu_pd, _mm_sqrt_pd)
PERI_TALLY(plain, PERI_VECTOR_CODE)
PERI_ROOTS(avx2, PERI_VECTOR_CODE PERI_TARGET_AVX2, 4, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_sqrt_pd)
PERI_TALLY(avx2, PERI_VECTOR_CODE PERI_TARGET_AVX2)
PERI_ROOTS(avx512, PERI_VECTOR_CODE PERI_TARGET_AVX512, 8, _mm512_loadu_pd, _mm512_storeu_pd, _mm512_sqrt_pd)
PERI_TALLY(avx512, PERI_VECTOR_CODE PERI_TARGET_AVX512)
#else
#define PERI_TALLY_LOAD(a) (*(a))
#define PERI_TALLY_STORE(a, value) (*(a) = (value))
PERI_ROOTS(plain, PERI_VECTOR_CODE, 1, PERI_TALLY_LOAD, PERI_TALLY_STORE, sqrt)
PERI_VECTOR_CODE static void peri__tally_plain(const double *length, const double *weight, int64_t count, double (*sum)[PERI_TALLY_LANES]) {
    PERI_NO_CONTRACTION
    for (int n = 0; n < 3; ++n)
        for (int l = 0; l < PERI_TALLY_LANES; ++l) sum[n][l] = 0.0;
    for (int64_t k = 0; k < count; k += PERI_TALLY_LANES)
        for (int l = 0; l < PERI_TALLY_LANES; ++l) {
            const double w = weight[k + l], bond = length[k + l];
            sum[0][l] += fabs(w);
            sum[1][l] += w * bond * bond;
            sum[2][l] += fabs(w) / bond;
        }
}
#undef PERI_TALLY_LOAD
#undef PERI_TALLY_STORE
#endif
#undef PERI_TALLY
#undef PERI_ROOTS

/* Weights of the hits of point i, entries `at` and on; taken of them. */
PERI_VECTOR_CODE static void peri__weigh_hits(const peri__cloud *c, peri__near *s, int64_t i, int64_t taken, int64_t at, peri__tally *t) {
    const peri__model *m = c->model;
    const peri_body_desc *desc = &c->body->desc;
    const int64_t whole = (taken + PERI_TALLY_LANES - 1) / PERI_TALLY_LANES * PERI_TALLY_LANES;
    double *length = s->length, *weight = s->square; /* which is measured anew for the next point */
    double sum[3][PERI_TALLY_LANES];
    for (int64_t k = taken; k < whole; ++k) length[k] = 1.0;
    PERI_BY_ISA(c->isa, peri__roots, (length, whole));
    if (desc->influence == PERI_INFLUENCE_CONSTANT) {
        for (int64_t k = 0; k < taken; ++k) weight[k] = 1.0;
    } else {
        for (int64_t k = 0; k < taken; ++k) weight[k] = length[k] / m->horizon;
        peri__influences(c->body, weight, taken, c->edge);
    }
    if (c->even > 0.0)
        for (int64_t k = 0; k < taken; ++k) weight[k] *= c->even;
    else
        for (int64_t k = 0; k < taken; ++k) {
            const double volume = m->volume[c->order[s->hit[k]]];
            weight[k] *= m->mutual ? m->volume[i] * volume : volume;
        }
    for (int64_t k = taken; k < whole; ++k) weight[k] = 0.0;
    if (c->body->b32) {
        float *out = (float *)m->weight + at;
        for (int64_t k = 0; k < taken; ++k) weight[k] = out[k] = (float)weight[k];
        for (int64_t k = 0; k < taken; ++k) /* the places of both ends are rounded by half a unit of the largest, per axis */
            if (length[k] < PERI_BLUR || m->extent * 4.0 * FLT_EPSILON > PERI_BLUR * length[k])
                t->blurred += peri__is_blurred(c, i, c->order[s->hit[k]], length[k]) || peri__is_lost(c, i, c->order[s->hit[k]]);
    } else {
        memcpy((double *)m->weight + at, weight, (size_t)taken * sizeof *weight);
    }
    PERI_BY_ISA(c->isa, peri__tally, (length, weight, whole, sum));
    for (int half = PERI_TALLY_LANES / 2; half > 0; half /= 2)
        for (int n = 0; n < 3; ++n)
            for (int l = 0; l < half; ++l) sum[n][l] += sum[n][l + half];
    t->total += sum[0][0];
    t->stiff += sum[1][0];
    if (m->materials == 1) t->row_sum += m->pairs[0].c * sum[2][0];
    else
        for (int64_t k = 0; k < taken; ++k)
            t->row_sum += m->pairs[m->material[i] * m->materials + m->material[c->order[s->hit[k]]]].c * fabs(weight[k]) / length[k];
}

/* Is all well with the weights of row i? *row_sum: as of peri__row_sum_block. */
static int peri__is_weighed(const peri__cloud *c, int64_t i, const peri__tally *t, double *row_sum) {
    const peri__model *m = c->model;
    const double share = peri__share(m, i), own = 2.0 * (t->row_sum / share) / m->rho[m->material[i]];
    if (!(own <= *row_sum) && !peri__is_ghost(m, i)) *row_sum = own;
    return t->blurred == 0
        && peri__check_weight(c->body, t->total / share, t->stiff / share, m->laws[m->material[i]].pairwise) == PERI_OK;
}

/* ---- weights of any rule, of the list ----------------------------------------------------------------------------- */

/* sums->a: largest 2 sum(c w beta V/|xi|)/rho of a bond-based point, by the list. */
static void peri__row_sum_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cloud *c = (const peri__cloud *)context;
    const peri__model *m = c->model;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t i = peri__nth(m, k);
        double row_sum = 0.0;
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at)
            row_sum += m->pairs[m->material[i] * m->materials + m->material[peri__entry_id(m, at)]].c
                  * fabs(peri__weight_of(m, i, m->weight, at)) / peri__listed_length(c, i, at);
        row_sum *= 2.0 / m->rho[m->material[i]];
        if (row_sum > sums->a && !peri__is_ghost(m, i)) sums->a = row_sum;
    }
}

/* Keeps the lengths of bonds. */
static int32_t peri__keep_lengths(peri_body *b, const peri__cloud *c) {
    peri__model *m = c->model;
    void *bond = peri__new(&m->memory, m->entries, peri__bond_real(b));
    if (!bond) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    for (int64_t i = 0; i < m->points; ++i)
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at)
            peri__put_real(bond, b->b32, at, peri__listed_length(c, i, at));
    m->bond = bond;
    return PERI_OK;
}

static int32_t peri__weigh(peri_body *b, peri__cloud *c, peri__sums *sums) {
    peri__model *m = c->model;
    if (c->weighs) return PERI_OK;
    const size_t real = peri__bond_real(b);
    const int parts = b->desc.quadrature != PERI_QUADRATURE_FULL, centroids = b->desc.quadrature == PERI_QUADRATURE_PARTIAL_CENTROID;
    if (!m->weight) m->weight = peri__new_tail(&m->memory, m->entries, real, PERI_GROUP);
    if (centroids) m->bond = peri__new(&m->memory, m->entries, real);
    if (parts) m->partial_volume = (float *)peri__new(&m->memory, m->entries, sizeof(float));
    if (centroids) m->centroid = peri__new(&m->memory, m->entries * m->dim, real);
    if (!m->weight || (parts && !m->partial_volume) || (centroids && (!m->bond || !m->centroid)))
        return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    if (b->desc.influence == PERI_INFLUENCE_USER) { /* the caller's function runs on the caller's thread */
        for (int64_t k = 0; k < m->blocks; ++k) {
            memset(&sums[k], 0, sizeof sums[k]);
            sums[k].bad = -1;
            peri__weigh_block(c, k * PERI_BLOCK, peri__min((k + 1) * PERI_BLOCK, m->points), &sums[k]);
        }
    } else {
        peri__for_points(b, m->points, 8 * m->width, peri__weigh_block, c, sums);
    }
    const peri__sums *first = NULL;
    for (int64_t k = 0; k < m->blocks; ++k)
        if (sums[k].bad >= 0 && (!first || sums[k].bad < first->bad)) first = &sums[k];
    if (first) return peri__fail(b, (int32_t)first->n, first->n == PERI_ERROR_COINCIDENT ? "precision" : "influence", first->bad, 0.0);
    const int kept = m->bond != NULL, needed = m->width > PERI_VECTOR_LIMIT || peri__total(sums, m->points).a > 0.0;
    return needed && !kept ? peri__keep_lengths(b, c) : PERI_OK;
}
