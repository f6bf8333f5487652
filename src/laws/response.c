/* response.c - what the live family of a point makes of its state-based law: the constants of peri__constant, and how stiff that is.

   Every law is calibrated on the bonds that are left, so a cut crack and a gap between points act alike. The price is that few
   short bonds carry what many did: the bound of the highest frequency is kept per point, and follows the bonds that break. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_SPAN 0.02 /* a shape tensor whose eigenvalues differ by more than this factor counts as singular              */

typedef struct peri__moments { /* sums over the bonds of a family, inner units                                            */
    double m;            /* w |xi|^2 V                                                                                   */
    double length;       /* w |xi| V                                                                                     */
    double plain;        /* w V                                                                                          */
    double shear;        /* w xi_a^2 xi_b^2/|xi|^2 V, mean over the planes a < b                                         */
    double shape[6];     /* w xi xi V                                                                                    */
} peri__moments;

static void peri__add_moments(peri__moments *sum, int32_t dim, const double *xi, double bond, double weight) {
    const double planes = dim * (dim - 1) / 2;
    sum->m += weight * bond * bond;
    sum->length += weight * bond;
    sum->plain += weight;
    for (int a = 0; a < dim; ++a)
        for (int c = a; c < dim; ++c) {
            sum->shape[peri__packed(dim, a, c)] += weight * xi[a] * xi[c];
            if (a != c) sum->shear += weight * peri__square(xi[a] * xi[c] / bond) / planes;
        }
}

/* Is m all that the law of all points is calibrated on? */
static int peri__needs_no_more(const peri__model *m) { return !m->mixed && m->gauge && !(m->gathers & PERI__GRADIENT); }

static peri__moments peri__family_moments(const peri_body *b, int64_t i, const peri__row *row, int live) {
    const peri__model *m = b->model;
    peri__moments sum;
    memset(&sum, 0, sizeof sum);
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 }, weight = peri__get_real(row->weight, b->b32, k), bond = peri__get_real(row->bond, b->b32, k);
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
    return m->gathers & PERI__GRADIENT ? PERI__INVERSE + PERI_PACKED(m->dim) : PERI__VECTOR;
}

static void peri__put_constant(peri_body *b, int64_t i, int plane, double value) {
    peri__put_real(b->constant, b->b32, b->model->margin + plane * b->model->stride + i, value);
}

PERI_INLINE double peri__get_constant(const peri_body *b, int64_t i, int plane) {
    return peri__get_real(b->constant, b->b32, b->model->margin + plane * b->model->stride + i);
}

typedef struct peri__response { /* see peri__constant                                                                        */
    double dilate, press, spring, vector, inverse[6];
} peri__response;

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
static int peri__respond(const peri__law *law, int32_t dim, const peri__moments *sum, peri__response *r) {
    memset(r, 0, sizeof *r);
    if (!(sum->m > 0.0)) return 1;
    switch (law->model) {
#define PERI_CASE(name, number) case number: return peri__calibrate_##name(law, dim, sum, r);
    PERI_LAW_LIST(PERI_CASE)
#undef PERI_CASE
    default: return 1;
    }
}

static void peri__set_constants(peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    if (law->pairwise) return;
    peri__response r;
    peri__moments sum = peri__family_moments(b, i, row, 1);
    if (!peri__respond(law, m->dim, &sum, &r)) r.spring = law->b / peri__family_moments(b, i, row, 0).m;
    peri__put_constant(b, i, PERI__DILATE, r.dilate);
    peri__put_constant(b, i, PERI__PRESS, r.press);
    peri__put_constant(b, i, PERI__SPRING, r.spring);
    if (!(m->gathers & PERI__GRADIENT)) return;
    peri__put_constant(b, i, PERI__VECTOR, r.vector);
    for (int k = 0; k < PERI_PACKED(m->dim); ++k) peri__put_constant(b, i, PERI__INVERSE + k, r.inverse[k]);
}

/* g of bonds at a point of a law, and q of its half of bond (i, j). */
PERI_INLINE double peri__law_gauge(const peri__law *law, double bond) { return law->gauge ? bond : 1.0; }

PERI_INLINE double peri__spring(const peri_body *b, int64_t i, int64_t j, double bond) {
    const peri__model *m = b->model;
    if (m->laws[m->material[i]].pairwise) return 0.5 * m->pairs[m->material[i] * m->materials + m->material[j]].c / bond;
    return peri__get_constant(b, i, PERI__SPRING);
}

/* ---- stiffness ---------------------------------------------------------------------------------------------------- */

/* At rest, the Hessian of the energy is that of springs, sum q w e^2, and of kappa theta^2 (or C |H|^2). Rows of the first sum to twice the
   springs. theta = G u with |G_ij| = d w g V: rows of G^T kappa G sum to sum_i |G_ij| kappa_i R_i with R_i the row sum of |G|. */

/* d g of a bond of point i, or |K^-1 xi|: the size of what the bond adds to theta or H. */
PERI_INLINE double peri__gauge(const peri_body *b, int64_t i, const double *xi, double bond) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    double square = 0.0;
    if (law->pairwise) return 0.0;
    if (!(law->gather & PERI__GRADIENT)) return peri__get_constant(b, i, PERI__DILATE) * peri__law_gauge(law, bond);
    for (int a = 0; a < m->dim; ++a) {
        double sum = 0.0;
        for (int c = 0; c < m->dim; ++c) sum += peri__get_constant(b, i, PERI__INVERSE + peri__packed(m->dim, a, c)) * xi[c];
        square += sum * sum;
    }
    return sqrt(square);
}

/* |sum_j G_ij| of the point itself: what a motion of i alone does to its theta or H. *sum: the row sum of |G|. */
static double peri__lean(const peri_body *b, int64_t i, const peri__row *row, double *sum) {
    const peri__model *m = b->model;
    double x = 0.0, y = 0.0, z = 0.0;
    const peri__law *law = &m->laws[m->material[i]];
    const int tensor = (law->gather & PERI__GRADIENT) != 0, by_length = law->gauge;
    const double dilate = peri__get_constant(b, i, PERI__DILATE);
    *sum = 0.0;
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 }, w = peri__get_real(row->weight, b->b32, k), bond = peri__get_real(row->bond, b->b32, k);
        if (!peri__is_alive(b, i, k)) continue;
        peri__bond_of(m, b->f32, i, row->ids[k], xi);
        *sum += fabs(w) * (by_length ? dilate * bond : peri__gauge(b, i, xi, bond));
        if (!tensor) w *= by_length ? dilate : dilate / bond; /* of a tensor K^-1 sum w xi is the sum: its size is taken below */
        x += w * xi[0];
        y += w * xi[1];
        z += w * xi[2];
    }
    const double lean[3] = { x, y, z };
    return tensor ? peri__gauge(b, i, lean, 1.0) : sqrt(peri__dot(lean, lean, m->dim));
}

static void peri__set_wide(peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    double sum, dilate = peri__get_constant(b, i, PERI__DILATE), stiff = 0.0;
    if (law->gather & PERI__GRADIENT) stiff = law->lambda > 0.0 ? m->dim * law->lambda + 2.0 * law->mu : 2.0 * law->mu;
    else if (dilate > 0.0) stiff = peri__get_constant(b, i, PERI__PRESS) / dilate;
    b->wide[i] = stiff > 0.0 ? stiff * (peri__lean(b, i, row, &sum) + sum) : 0.0;
}

/* Stiffness of the half of point i in bond (i, j), per weight. */
static double peri__half_stiffness(const peri_body *b, int64_t i, int64_t j, double bond) {
    const peri__law *law = &b->model->laws[b->model->material[i]];
    return peri__spring(b, i, j, bond) + (law->gather & PERI__GRADIENT ? peri__get_constant(b, i, PERI__VECTOR) : 0.0);
}

static void peri__set_rate(peri_body *b, int64_t i) {
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
            b->central[i / PERI_LANES] = 1;
        sum += 2.0 * (own * peri__half_stiffness(b, i, j, bond) + back * peri__half_stiffness(b, j, i, bond));
        if (b->wide[j] > 0.0) sum += back * peri__gauge(b, j, xi, bond) * b->wide[j];
    }
    if (b->wide[i] > 0.0) sum += peri__lean(b, i, &row, &whole) * b->wide[i];
    b->rate[i] = sum / m->rho[m->material[i]];
}

/* ---- bodies on columns whose bonds are all alive ------------------------------------------------------------------- */

/* Groups with the same columns have the same constants: the first of them works them out, the others copy. Which that is stands in rate, by
   group, until rates are made. */
static void peri__find_models(peri_body *b) {
    const peri__lanes *l = &b->model->lanes;
    int32_t seen[1024] = { 0 }; /* the last group + 1 that was the first of its kind, by a hash of its columns                */
    for (int64_t g = 0; g < l->groups; ++g) {
        int32_t *slot = &seen[((uint64_t)l->first[g] * UINT64_C(0x9E3779B97F4A7C15)) >> 54];
        if (*slot == 0 || l->first[*slot - 1] != l->first[g]) *slot = (int32_t)(g + 1);
        b->rate[g] = *slot - 1;
    }
}

static void peri__copy_models(peri_body *b, int planes) {
    const peri__model *m = b->model;
    const size_t real = peri__bond_real(b);
    for (int64_t g = 0; g < m->lanes.groups; ++g) {
        const int64_t to = g * PERI_LANES, from = (int64_t)b->rate[g] * PERI_LANES, count = peri__min(PERI_LANES, m->points - to);
        for (int plane = 0; from != to && plane < planes; ++plane) {
            char *constant = (char *)b->constant + (size_t)(m->margin + plane * m->stride) * real;
            memcpy(constant + (size_t)to * real, constant + (size_t)from * real, (size_t)count * real);
        }
        if (from != to) memcpy(&b->wide[to], &b->wide[from], (size_t)count * sizeof *b->wide);
    }
}

/* What peri__set_rate makes of the points of group g, one law and ordinary. Of a point wide = stiff (lean + sum), see peri__set_wide. */
static void peri__group_rates(peri_body *b, int64_t g) {
    const peri__model *m = b->model;
    const peri__lanes *l = &m->lanes;
    const peri__column *column = &l->column[l->first[g]];
    const int64_t first = g * PERI_LANES, count = peri__min(PERI_LANES, m->points - first);
    double spring[PERI_LANES], sum[PERI_LANES] = { 0.0 }, gauged[PERI_LANES] = { 0.0 };
    for (int64_t n = 0; n < count; ++n) spring[n] = peri__get_constant(b, first + n, PERI__SPRING);
    for (int64_t c = l->begin[g]; c < l->begin[g + 1]; ++c, ++column) {
        const peri__stencil_bond *entry = &l->table[column->vector];
        const double w = fabs(entry->weight), gauge = w * (m->gauge ? entry->length : 1.0);
        for (int64_t n = 0, j = first + column->offset; n < count; ++n, ++j) {
            if (!(column->member >> n & 1)) continue;
            sum[n] += 2.0 * w * (spring[n] + peri__get_constant(b, j, PERI__SPRING))
                    + gauge * peri__get_constant(b, j, PERI__DILATE) * b->wide[j];
            gauged[n] += gauge;
        }
    }
    for (int64_t n = 0; n < count; ++n) {
        const double wide = b->wide[first + n], dilate = peri__get_constant(b, first + n, PERI__DILATE);
        const double lean = wide > 0.0 ? wide * dilate / peri__get_constant(b, first + n, PERI__PRESS) - dilate * gauged[n] : 0.0;
        b->rate[first + n] = (sum[n] + (lean > 0.0 ? lean * wide : 0.0)) / m->rho[m->material[first + n]];
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
        if (r->whole && b->rate[i / PERI_LANES] != (double)(i / PERI_LANES)) continue;
        peri__read_row(b, i, &row);
        peri__set_constants(b, i, &row);
        peri__set_wide(b, i, &row);
    }
}

static void peri__rates_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__refresher *r = (const peri__refresher *)context;
    peri_body *b = r->body;
    (void)sums;
    if (r->whole && !b->model->mixed && !(b->model->gathers & PERI__GRADIENT))
        for (int64_t g = begin / PERI_LANES; g * PERI_LANES < end; ++g) peri__group_rates(b, g);
    else
        for (int64_t i = begin; i < end; ++i) peri__set_rate(b, i);
}

static void peri__find_fastest(peri_body *b) {
    b->fastest = 0.0;
    for (int64_t i = 0; i < b->model->points; ++i)
        if (!(b->rate[i] <= b->fastest)) b->fastest = b->rate[i]; /* NaN, too: it is refused */
}

/* Brings the constants up to date with the bonds that are left. */
static void peri__refresh(peri_body *b) {
    peri__refresher r;
    if (!(b->now.stale & PERI__STALE_CONSTANTS)) return;
    r.body = b;
    r.whole = b->model->lanes.columns > 0 && b->now.cut == 0 && b->now.broken == 0;
    if (r.whole) peri__find_models(b);
    if (b->central) memset(b->central, 0, (size_t)(b->model->points / PERI_LANES + 1));
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__constants_block, &r, NULL);
    if (r.whole) peri__copy_models(b, peri__constant_planes(b->model));
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__rates_block, &r, NULL);
    peri__find_fastest(b);
    b->now.stale &= ~(uint32_t)PERI__STALE_CONSTANTS;
}
