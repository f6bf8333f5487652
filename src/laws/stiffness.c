/* SPDX-License-Identifier: MIT */
/* stiffness.c - bounds of the highest frequency by row sums of the stiffness, point by point, so that they follow the bonds that break;
   and what keeps constants and row sums up to date. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* At rest twice the energy is the sum of the squares of springs, k ((u_i - u_j).n)^2 <= 2 k (u_i.n)^2 + 2 k (u_j.n)^2, of the
   stabilisation, likewise, and of kappa theta^2, or C:H:H. theta_i = sum_j g_ij.u_j with g_ij = d w g V n, itself included; with
   R_i = sum_j |g_ij|

     kappa_i theta_i^2 <= kappa_i R_i sum_j |g_ij| (u_j.n_ij)^2

   since the square is convex; and so of H_i = sum_j u_j g_ij, g_ij = w V K^-1 xi, where C:un:un = (lambda + mu) (u.n)^2 + mu u^2.
   All this is sum_i V_i u_i.S_i u_i: the square of the highest frequency is the largest eigenvalue of an S_i/rho_i at most. Row sums,
   which have u^2 for (u.n)^2, are D times as much where bonds point everywhere. The centroid rule, whose stiffness is not symmetric,
   has those.
   The largest eigenvalue of a symmetric matrix is at most tr/D + sqrt((D - 1)/D) |its deviator|; in the plane just that. */
PERI_INLINE double peri__largest_eigenvalue(int32_t dim, const double *s) {
    double mean = 0.0, square = 0.0;
    for (int a = 0; a < dim; ++a) mean += s[a] / dim;
    for (int a = 0; a < dim; ++a) square += peri__square(s[a] - mean);
    for (int k = dim; k < PERI_PACKED(dim); ++k) square += 2.0 * peri__square(s[k]);
    return mean + sqrt((dim - 1.0) / dim * square);
}

/* s += along n n + round 1, n = v/|v|. */
PERI_INLINE void peri__add_stiffness(int32_t dim, double along, double round, const double *v, double length, double *s) {
    const double scale = length > 0.0 ? along / (length * length) : 0.0;
    for (int a = 0; a < dim; ++a) {
        s[a] += scale * v[a] * v[a] + round;
        for (int c = a + 1; c < dim; ++c) s[peri__packed(dim, a, c)] += scale * v[a] * v[c];
    }
}

/* What a point has by its part g (|g| = size) in a theta or H of the law, of which gather_row_sum is the kappa R, or R. even: wherever g
   points. */
PERI_INLINE void peri__add_gathered(const peri__law *law, int32_t dim, int even, double gather_row_sum, const double *g, double size,
                                    double *s) {
    const double sum = gather_row_sum * size, stiff = law->lambda > 0.0 ? dim * law->lambda + 2.0 * law->mu : 2.0 * law->mu;
    if (!(law->gather & PERI__GRADIENT)) peri__add_stiffness(dim, even ? 0.0 : sum, even ? sum : 0.0, g, size, s);
    else if (even) peri__add_stiffness(dim, 0.0, stiff * sum, g, size, s);
    else peri__add_stiffness(dim, (law->lambda + law->mu) * sum, law->mu * sum, g, size, s);
}

/* d g n of a bond of point i, or K^-1 xi: what the bond adds to theta or H, over w V. Returns its size. */
PERI_INLINE double peri__gather_vector(const peri_body *b, int32_t dim, int64_t i, const double *xi, double bond, double *g) {
    const peri__law *law = &b->model->laws[b->model->material[i]];
    if (law->gather & PERI__GRADIENT) {
        for (int a = 0; a < dim; ++a) {
            g[a] = 0.0;
            for (int c = 0; c < dim; ++c) g[a] += peri__get_constant(b, i, PERI__SHAPE_INVERSE + peri__packed(dim, a, c)) * xi[c];
        }
        return sqrt(peri__dot(g, g, dim));
    }
    const double size = law->pairwise ? 0.0 : peri__get_constant(b, i, PERI__THETA_FACTOR) * peri__law_gauge(law, bond);
    for (int a = 0; a < dim; ++a) g[a] = size / bond * xi[a];
    return size;
}

/* g_ii, what a motion of i alone does to its theta or H. *sum: R_i. */
PERI_INLINE void peri__gather_diagonal(const peri_body *b, int32_t dim, int64_t i, const peri__row *row, double *diagonal, double *sum) {
    const peri__model *m = b->model;
    diagonal[0] = diagonal[1] = diagonal[2] = *sum = 0.0;
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 }, g[3] = { 0.0, 0.0, 0.0 }, w = peri__weight_of(m, i, row->weight, k);
        if (!peri__is_alive(b, i, k)) continue;
        peri__bond_of(m, b->f32, i, row->ids[k], xi);
        *sum += fabs(w) * peri__gather_vector(b, dim, i, xi, peri__get_real(row->bond, b->b32, k), g);
        for (int a = 0; a < dim; ++a) diagonal[a] += w * g[a];
    }
    *sum += sqrt(peri__dot(diagonal, diagonal, dim));
}

/* kappa R; R of a gradient. 0 where there is no kappa, or it is below 0. */
static void peri__set_gather_row_sum(peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    double sum = 0.0, diagonal[3], theta_factor = peri__get_constant(b, i, PERI__THETA_FACTOR), stiff = 0.0;
    if (law->gather & PERI__GRADIENT) stiff = 1.0;
    else if (theta_factor > 0.0) stiff = peri__get_constant(b, i, PERI__PRESSURE_FACTOR) / theta_factor;
    if (stiff > 0.0 && m->dim == 2) peri__gather_diagonal(b, 2, i, row, diagonal, &sum);
    else if (stiff > 0.0) peri__gather_diagonal(b, 3, i, row, diagonal, &sum);
    b->gather_row_sum[i] = stiff > 0.0 ? stiff * sum : 0.0;
}

/* dim is a constant where this is inlined. */
PERI_INLINE double peri__row_sum_of(const peri_body *b, int32_t dim, int64_t i) {
    const peri__model *m = b->model;
    double s[6] = { 0.0 }, g[3] = { 0.0 };
    peri__law room;
    const int tensors = (m->gathers & PERI__GRADIENT) != 0, even = m->centroid != NULL;
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        int64_t j = row.ids[k];
        double xi[3] = { 0.0, 0.0, 0.0 }, bond = peri__get_real(row.bond, b->b32, k);
        double own = fabs(peri__weight_of(m, i, row.weight, k)), back = fabs(peri__weight_of(m, i, row.back, k));
        if (!peri__is_alive(b, i, k)) continue;
        peri__bond_of(m, b->f32, i, j, xi);
        if (tensors && (peri__get_constant(b, i, PERI__SPRING) > 0.0 || peri__get_constant(b, j, PERI__SPRING) > 0.0))
            b->central[i / peri__central_of(b->model)] = 1;
        const double along = 2.0 * (own * peri__spring(b, i, j, bond) + back * peri__spring(b, j, i, bond));
        double round = even ? along : 0.0;
        if (tensors)
            round += 2.0 * (own * peri__get_constant(b, i, PERI__STABILIZATION) + back * peri__get_constant(b, j, PERI__STABILIZATION));
        peri__add_stiffness(dim, even ? 0.0 : along, round, xi, bond, s);
        if (!(b->gather_row_sum[j] > 0.0)) continue;
        const double size = peri__gather_vector(b, dim, j, xi, bond, g);
        peri__add_gathered(peri__law_at(b, j, &room), dim, even, back * b->gather_row_sum[j], g, size, s);
    }
    if (b->gather_row_sum[i] > 0.0) {
        double whole;
        peri__gather_diagonal(b, dim, i, &row, g, &whole);
        peri__add_gathered(peri__law_at(b, i, &room), dim, even, b->gather_row_sum[i], g, sqrt(peri__dot(g, g, dim)), s);
    }
    return peri__largest_eigenvalue(dim, s) / peri__density_at(b, i);
}

static void peri__set_row_sum(peri_body *b, int64_t i) {
    b->row_sum[i] = b->model->dim == 2 ? peri__row_sum_of(b, 2, i) : peri__row_sum_of(b, 3, i);
}

/* ---- bodies on columns whose bonds are all alive ------------------------------------------------------------------- */

/* Groups with the same columns have the same constants: the first of them works them out, the others copy. Which that is stands in row_sum,
   by group, until row sums are made. */
static void peri__find_equal_groups(peri_body *b) {
    const peri__stencil *l = &b->model->stencil;
    int32_t seen[1024] = { 0 }; /* the last group + 1 that was the first of its kind, by a hash of its columns           */
    for (int64_t g = 0; g < l->groups; ++g) {
        int32_t *slot = &seen[((uint64_t)l->first[g] * UINT64_C(0x9E3779B97F4A7C15)) >> 54];
        if (*slot == 0 || l->first[*slot - 1] != l->first[g]) *slot = (int32_t)(g + 1);
        b->row_sum[g] = *slot - 1;
    }
}

static void peri__copy_equal_groups(peri_body *b, int planes) {
    const peri__model *m = b->model;
    const size_t real = peri__bond_real(b);
    for (int64_t g = 0; g < m->stencil.groups; ++g) {
        const int64_t to = g * PERI_GROUP, from = (int64_t)b->row_sum[g] * PERI_GROUP, count = peri__min(PERI_GROUP, m->points - to);
        for (int plane = 0; from != to && plane < planes; ++plane) {
            char *constant = (char *)b->constant + (size_t)(m->margin + plane * m->stride) * real;
            memcpy(constant + (size_t)to * real, constant + (size_t)from * real, (size_t)count * real);
        }
        if (from != to) memcpy(&b->gather_row_sum[to], &b->gather_row_sum[from], (size_t)count * sizeof *b->gather_row_sum);
    }
}

/* What peri__set_row_sum makes of the points of group g, one law and ordinary; dim is a constant where this is inlined. Lanes without a
   point, or without the bond, count for nothing. Of a point gather_row_sum = kappa R. */
PERI_INLINE void peri__group_row_sums(peri_body *b, int32_t dim, int64_t g) {
    const peri__model *m = b->model;
    const peri__stencil *l = &m->stencil;
    const peri__column *column = &l->column[l->first[g]];
    const int64_t first = g * PERI_GROUP, count = peri__min(PERI_GROUP, m->points - first);
    double spring[PERI_GROUP] = { 0.0 }, along[PERI_GROUP], there[PERI_GROUP];
    double sum[6][PERI_GROUP] = { { 0.0 } }, diagonal[3][PERI_GROUP] = { { 0.0 } };
    for (int64_t n = 0; n < count; ++n) spring[n] = peri__get_constant(b, first + n, PERI__SPRING);
    for (int64_t c = l->begin[g]; c < l->begin[g + 1]; ++c, ++column) {
        const peri__stencil_bond *entry = &l->table[column->vector];
        const double w = fabs(entry->weight), gauge = m->gauge ? entry->length : 1.0, pull = entry->weight * gauge / entry->length;
        double dyad[6] = { 0.0 };
        peri__add_stiffness(dim, 1.0, 0.0, entry->xi, entry->length, dyad);
        for (int64_t n = 0, j = first + column->offset; n < PERI_GROUP; ++n, ++j) {
            along[n] = there[n] = 0.0;
            if (!(column->member >> n & 1)) continue;
            there[n] = 1.0;
            along[n] = 2.0 * w * (spring[n] + peri__get_constant(b, j, PERI__SPRING))
                     + w * gauge * peri__get_constant(b, j, PERI__THETA_FACTOR) * b->gather_row_sum[j];
        }
        for (int k = 0; k < PERI_PACKED(dim); ++k)
            for (int n = 0; n < PERI_GROUP; ++n) sum[k][n] += along[n] * dyad[k];
        for (int a = 0; a < dim; ++a)
            for (int n = 0; n < PERI_GROUP; ++n) diagonal[a][n] += there[n] * (pull * entry->xi[a]);
    }
    for (int64_t n = 0; n < count; ++n) {
        const double share = peri__share(m, first + n);
        double s[6] = { 0.0 }, own[3] = { 0.0 };
        for (int k = 0; k < PERI_PACKED(dim); ++k) s[k] = sum[k][n] / share;
        for (int a = 0; a < dim; ++a) own[a] = diagonal[a][n] / share;
        const double size = sqrt(peri__dot(own, own, dim));
        const double gathered = size * peri__get_constant(b, first + n, PERI__THETA_FACTOR) * b->gather_row_sum[first + n];
        peri__add_stiffness(dim, gathered, 0.0, own, size, s);
        b->row_sum[first + n] = peri__largest_eigenvalue(dim, s) / peri__density_at(b, first + n);
    }
}

/* ---- all bodies --------------------------------------------------------------------------------------------------- */

typedef struct peri__refresher {
    peri_body *body;
    int        whole; /* on columns, all bonds alive                                                                     */
} peri__refresher;

static void peri__constants_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__refresher *r = (const peri__refresher *)context;
    peri_body *b = r->body;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        if (r->whole && b->row_sum[i / PERI_GROUP] != (double)(i / PERI_GROUP)) continue;
        peri__read_row(b, i, &row);
        peri__set_constants(b, i, &row);
        peri__set_gather_row_sum(b, i, &row);
    }
}

static void peri__row_sums_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__refresher *r = (const peri__refresher *)context;
    peri_body *b = r->body;
    (void)sums;
    if (r->whole && !b->model->mixed && !(b->model->gathers & PERI__GRADIENT))
        for (int64_t g = begin / PERI_GROUP; g * PERI_GROUP < end; ++g) {
            if (b->dim == 2) peri__group_row_sums(b, 2, g);
            else peri__group_row_sums(b, 3, g);
        }
    else
        for (int64_t i = begin; i < end; ++i) peri__set_row_sum(b, i);
}

static void peri__find_largest_row_sum(peri_body *b) {
    b->largest_row_sum = 0.0;
    for (int64_t i = 0; i < b->model->points; ++i)
        if (!(b->row_sum[i] <= b->largest_row_sum) && !peri__is_ghost(b->model, i))
            b->largest_row_sum = b->row_sum[i]; /* NaN, too: it is refused */
}

/* Brings the constants up to date with the bonds that are left. */
static void peri__refresh(peri_body *b) {
    peri__refresher r;
    if (!(b->now.stale & PERI__STALE_CONSTANTS)) return;
    r.body = b;
    r.whole = b->model->stencil.columns > 0 && b->now.cut == 0 && b->now.broken == 0 && !b->stiffness
          && !b->model->part; /* of which some may be whole and others not */
    if (r.whole) peri__find_equal_groups(b);
    if (b->central) memset(b->central, 0, (size_t)(b->model->points / peri__central_of(b->model) + 1));
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__constants_block, &r, NULL);
    if (r.whole) peri__copy_equal_groups(b, peri__constant_planes(b->model));
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__row_sums_block, &r, NULL);
    peri__find_largest_row_sum(b);
    b->now.stale &= ~(uint32_t)PERI__STALE_CONSTANTS;
}
