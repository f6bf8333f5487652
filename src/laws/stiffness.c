/* SPDX-License-Identifier: MIT */
/* stiffness.c - bounds of the highest frequency by row sums of the stiffness, point by point, so that they follow the bonds that break;
   and what keeps constants and row sums up to date. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* At rest, the Hessian of the energy is that of springs, sum q w e^2, and of kappa theta^2 (or C |H|^2). Rows of the first sum to twice the
   springs. theta = G u with |G_ij| = d w g V: rows of G^T kappa G sum to sum_i |G_ij| kappa_i R_i with R_i the row sum of |G|. */

/* d g of a bond of point i, or |K^-1 xi|: the size of what the bond adds to theta or H. */
PERI_INLINE double peri__gather_weight(const peri_body *b, int64_t i, const double *xi, double bond) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    double square = 0.0;
    if (law->pairwise) return 0.0;
    if (!(law->gather & PERI__GRADIENT)) return peri__get_constant(b, i, PERI__THETA_FACTOR) * peri__law_gauge(law, bond);
    for (int a = 0; a < m->dim; ++a) {
        double sum = 0.0;
        for (int c = 0; c < m->dim; ++c) sum += peri__get_constant(b, i, PERI__SHAPE_INVERSE + peri__packed(m->dim, a, c)) * xi[c];
        square += sum * sum;
    }
    return sqrt(square);
}

/* |sum_j G_ij| of the point itself: what a motion of i alone does to its theta or H. *sum: the row sum of |G|. */
static double peri__gather_diagonal(const peri_body *b, int64_t i, const peri__row *row, double *sum) {
    const peri__model *m = b->model;
    double x = 0.0, y = 0.0, z = 0.0;
    const peri__law *law = &m->laws[m->material[i]];
    const int tensor = (law->gather & PERI__GRADIENT) != 0, by_length = law->gauge;
    const double theta_factor = peri__get_constant(b, i, PERI__THETA_FACTOR);
    *sum = 0.0;
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 }, w = peri__get_real(row->weight, b->b32, k), bond = peri__get_real(row->bond, b->b32, k);
        if (!peri__is_alive(b, i, k)) continue;
        peri__bond_of(m, b->f32, i, row->ids[k], xi);
        *sum += fabs(w) * (by_length ? theta_factor * bond : peri__gather_weight(b, i, xi, bond));
        if (!tensor) w *= by_length ? theta_factor : theta_factor / bond; /* of a tensor the sum is K^-1 sum w xi: its size is below */
        x += w * xi[0];
        y += w * xi[1];
        z += w * xi[2];
    }
    const double gather_diagonal[3] = { x, y, z };
    return tensor ? peri__gather_weight(b, i, gather_diagonal, 1.0) : sqrt(peri__dot(gather_diagonal, gather_diagonal, m->dim));
}

static void peri__set_gather_row_sum(peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    double sum, theta_factor = peri__get_constant(b, i, PERI__THETA_FACTOR), stiff = 0.0;
    if (law->gather & PERI__GRADIENT) stiff = law->lambda > 0.0 ? m->dim * law->lambda + 2.0 * law->mu : 2.0 * law->mu;
    else if (theta_factor > 0.0) stiff = peri__get_constant(b, i, PERI__PRESSURE_FACTOR) / theta_factor;
    b->gather_row_sum[i] = stiff > 0.0 ? stiff * (peri__gather_diagonal(b, i, row, &sum) + sum) : 0.0;
}

/* Stiffness of the half of point i in bond (i, j), per weight. */
static double peri__half_stiffness(const peri_body *b, int64_t i, int64_t j, double bond) {
    const peri__law *law = &b->model->laws[b->model->material[i]];
    return peri__spring(b, i, j, bond) + (law->gather & PERI__GRADIENT ? peri__get_constant(b, i, PERI__STABILIZATION) : 0.0);
}

static void peri__set_row_sum(peri_body *b, int64_t i) {
    const peri__model *m = b->model;
    double sum = 0.0, whole;
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        int64_t j = row.ids[k];
        double xi[3] = { 0.0, 0.0, 0.0 }, bond = peri__get_real(row.bond, b->b32, k);
        double own = fabs(peri__get_real(row.weight, b->b32, k)), back = fabs(peri__get_real(row.back, b->b32, k));
        if (!peri__is_alive(b, i, k)) continue;
        if (m->gathers & PERI__GRADIENT) peri__bond_of(m, b->f32, i, j, xi);
        if (m->gathers & PERI__GRADIENT && (peri__get_constant(b, i, PERI__SPRING) > 0.0 || peri__get_constant(b, j, PERI__SPRING) > 0.0))
            b->central[i / PERI_GROUP] = 1;
        sum += 2.0 * (own * peri__half_stiffness(b, i, j, bond) + back * peri__half_stiffness(b, j, i, bond));
        if (b->gather_row_sum[j] > 0.0) sum += back * peri__gather_weight(b, j, xi, bond) * b->gather_row_sum[j];
    }
    if (b->gather_row_sum[i] > 0.0) sum += peri__gather_diagonal(b, i, &row, &whole) * b->gather_row_sum[i];
    b->row_sum[i] = sum / m->rho[m->material[i]];
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

/* What peri__set_row_sum makes of the points of group g, one law and ordinary. Of a point gather_row_sum =
   stiff (gather_diagonal + sum), see peri__set_gather_row_sum. */
static void peri__group_row_sums(peri_body *b, int64_t g) {
    const peri__model *m = b->model;
    const peri__stencil *l = &m->stencil;
    const peri__column *column = &l->column[l->first[g]];
    const int64_t first = g * PERI_GROUP, count = peri__min(PERI_GROUP, m->points - first);
    double spring[PERI_GROUP], sum[PERI_GROUP] = { 0.0 }, gauged[PERI_GROUP] = { 0.0 };
    for (int64_t n = 0; n < count; ++n) spring[n] = peri__get_constant(b, first + n, PERI__SPRING);
    for (int64_t c = l->begin[g]; c < l->begin[g + 1]; ++c, ++column) {
        const peri__stencil_bond *entry = &l->table[column->vector];
        const double w = fabs(entry->weight), gauge = w * (m->gauge ? entry->length : 1.0);
        for (int64_t n = 0, j = first + column->offset; n < count; ++n, ++j) {
            if (!(column->member >> n & 1)) continue;
            sum[n] += 2.0 * w * (spring[n] + peri__get_constant(b, j, PERI__SPRING))
                    + gauge * peri__get_constant(b, j, PERI__THETA_FACTOR) * b->gather_row_sum[j];
            gauged[n] += gauge;
        }
    }
    for (int64_t n = 0; n < count; ++n) {
        const double gather_row_sum = b->gather_row_sum[first + n], theta_factor = peri__get_constant(b, first + n, PERI__THETA_FACTOR);
        const double pressure_factor = peri__get_constant(b, first + n, PERI__PRESSURE_FACTOR);
        const double inner = theta_factor * gauged[n];
        const double gather_diagonal = gather_row_sum > 0.0 ? gather_row_sum * theta_factor / pressure_factor - inner : 0.0;
        const double own = gather_diagonal > 0.0 ? gather_diagonal * gather_row_sum : 0.0;
        b->row_sum[first + n] = (sum[n] + own) / m->rho[m->material[first + n]];
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
        for (int64_t g = begin / PERI_GROUP; g * PERI_GROUP < end; ++g) peri__group_row_sums(b, g);
    else
        for (int64_t i = begin; i < end; ++i) peri__set_row_sum(b, i);
}

static void peri__find_largest_row_sum(peri_body *b) {
    b->largest_row_sum = 0.0;
    for (int64_t i = 0; i < b->model->points; ++i)
        if (!(b->row_sum[i] <= b->largest_row_sum)) b->largest_row_sum = b->row_sum[i]; /* NaN, too: it is refused */
}

/* Brings the constants up to date with the bonds that are left. */
static void peri__refresh(peri_body *b) {
    peri__refresher r;
    if (!(b->now.stale & PERI__STALE_CONSTANTS)) return;
    r.body = b;
    r.whole = b->model->stencil.columns > 0 && b->now.cut == 0 && b->now.broken == 0;
    if (r.whole) peri__find_equal_groups(b);
    if (b->central) memset(b->central, 0, (size_t)(b->model->points / PERI_GROUP + 1));
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__constants_block, &r, NULL);
    if (r.whole) peri__copy_equal_groups(b, peri__constant_planes(b->model));
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__row_sums_block, &r, NULL);
    peri__find_largest_row_sum(b);
    b->now.stale &= ~(uint32_t)PERI__STALE_CONSTANTS;
}
