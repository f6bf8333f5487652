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

static int peri__is_alive(const peri_body *b, int64_t i, int64_t k) {
    return !b->alive || (b->alive[i * b->model->words + k / 32] >> (k % 32) & 1);
}

static void peri__bond_of(const peri__model *m, int f32, int64_t i, int64_t j, double *xi) {
    for (int32_t d = 0; d < m->dim; ++d)
        xi[d] = peri__get_real(m->x, f32, d * m->stride + j) - peri__get_real(m->x, f32, d * m->stride + i);
}

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

static peri__moments peri__family_moments(const peri_body *b, int64_t i, const peri__row *row, int live) {
    const peri__model *m = b->model;
    peri__moments sum;
    memset(&sum, 0, sizeof sum);
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 }, weight = peri__get_real(row->weight, b->b32, k), bond = peri__get_real(row->bond, b->b32, k);
        if (live && !peri__is_alive(b, i, k)) continue;
        peri__bond_of(m, b->f32, i, row->ids[k], xi);
        peri__add_moments(&sum, m->dim, xi, bond, weight);
    }
    return sum;
}

static void peri__put_constant(peri_body *b, int64_t i, int plane, double value) {
    peri__put_real(b->constant, b->b32, b->model->margin + plane * b->model->stride + i, value);
}

static double peri__get_constant(const peri_body *b, int64_t i, int plane) {
    return peri__get_real(b->constant, b->b32, b->model->margin + plane * b->model->stride + i);
}

typedef struct peri__response { /* see peri__constant                                                                        */
    double dilate, press, spring, vector, inverse[6];
} peri__response;

/* What a state-based law makes of a family, all zero where that has no bonds. 0 where a correspondence family spans too little: it acts by
   springs, which are the caller's to give. */
static int peri__respond(const peri__law *law, int32_t dim, const peri__moments *sum, peri__response *r) {
    memset(r, 0, sizeof *r);
    if (!(sum->m > 0.0)) return 1;
    if (law->model == PERI_LPS) {
        r->dilate = dim / sum->m;
        r->press = law->a / dim * r->dilate;
        r->spring = law->b / sum->m;
    } else if (law->model == PERI_OTERKUS) {
        /* b = mu/(2 S), a = (bulk - 2 b m/D^2)/2 ([C] 16, 17); a family without shear bonds to calibrate on takes that of LPS. The energy
           is never negative while q + (bulk - q m/D^2) D^2 sum(w V)/(sum w |xi| V)^2 >= 0 (Cauchy-Schwarz): q stays within that. */
        const double room = sum->m * sum->plain / (sum->length * sum->length) - 1.0, most = law->bulk * dim * dim * (1.0 + room);
        r->dilate = dim / sum->length;
        r->spring = dim * (dim + 2) * sum->shear > 0.2 * sum->m ? law->mu / sum->shear : law->b / sum->m;
        if (r->spring * sum->m * room > most) r->spring = most / (room * sum->m);
        r->press = (law->bulk - r->spring * sum->m / (dim * dim)) * r->dilate;
    } else if (peri__invert(dim, sum->shape, PERI_SPAN, r->inverse) == dim) {
        r->vector = law->stabilization * law->b / sum->m;
    } else {
        memset(r->inverse, 0, sizeof r->inverse);
        return 0;
    }
    return 1;
}

static void peri__set_constants(peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    if (law->model == PERI_BOND_BASED) return;
    peri__response r;
    peri__moments sum = peri__family_moments(b, i, row, 1);
    if (!peri__respond(law, m->dim, &sum, &r)) r.spring = law->b / peri__family_moments(b, i, row, 0).m;
    peri__put_constant(b, i, PERI__DILATE, r.dilate);
    peri__put_constant(b, i, PERI__PRESS, r.press);
    peri__put_constant(b, i, PERI__SPRING, r.spring);
    if (!m->tensors) return;
    peri__put_constant(b, i, PERI__VECTOR, r.vector);
    for (int k = 0; k < PERI_PACKED(m->dim); ++k) peri__put_constant(b, i, PERI__INVERSE + k, r.inverse[k]);
}

/* ---- stiffness ---------------------------------------------------------------------------------------------------- */

/* At rest, the Hessian of the energy is that of springs, sum q w e^2, and of kappa theta^2 (or C |H|^2). Rows of the first sum to twice the
   springs. theta = G u with |G_ij| = d w g V: rows of G^T kappa G sum to sum_i |G_ij| kappa_i R_i with R_i the row sum of |G|. */

/* d g of a bond of point i, or |K^-1 xi|: the size of what the bond adds to theta or H. */
static double peri__gauge(const peri_body *b, int64_t i, const double *xi, double bond) {
    const peri__model *m = b->model;
    double square = 0.0;
    switch (m->laws[m->material[i]].model) {
    case PERI_LPS: return peri__get_constant(b, i, PERI__DILATE) * bond;
    case PERI_OTERKUS: return peri__get_constant(b, i, PERI__DILATE);
    case PERI_CORRESPONDENCE: break;
    default: return 0.0;
    }
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
    double lean[3] = { 0.0, 0.0, 0.0 };
    int tensor = m->laws[m->material[i]].model == PERI_CORRESPONDENCE;
    *sum = 0.0;
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 }, w = peri__get_real(row->weight, b->b32, k), bond = peri__get_real(row->bond, b->b32, k);
        if (!peri__is_alive(b, i, k)) continue;
        peri__bond_of(m, b->f32, i, row->ids[k], xi);
        double gauge = peri__gauge(b, i, xi, bond);
        *sum += fabs(w) * gauge;
        for (int d = 0; d < m->dim; ++d) /* of a tensor K^-1 sum w xi is the sum: its size is taken below */
            lean[d] += w * (tensor ? xi[d] : gauge * xi[d] / bond);
    }
    return tensor ? peri__gauge(b, i, lean, 1.0) : sqrt(peri__dot(lean, lean, m->dim));
}

static void peri__set_wide(peri_body *b, int64_t i, const peri__row *row) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    double sum, dilate = peri__get_constant(b, i, PERI__DILATE), stiff = 0.0;
    if (law->model == PERI_CORRESPONDENCE) stiff = law->lambda > 0.0 ? m->dim * law->lambda + 2.0 * law->mu : 2.0 * law->mu;
    else if (dilate > 0.0) stiff = peri__get_constant(b, i, PERI__PRESS) / dilate;
    b->wide[i] = stiff > 0.0 ? stiff * (peri__lean(b, i, row, &sum) + sum) : 0.0;
}

/* Stiffness of the half of point i in bond (i, j), per weight. */
static double peri__half_stiffness(const peri_body *b, int64_t i, int64_t j, double bond) {
    const peri__model *m = b->model;
    if (m->laws[m->material[i]].model == PERI_BOND_BASED)
        return 0.5 * m->pairs[m->material[i] * m->materials + m->material[j]].c / bond;
    return peri__get_constant(b, i, PERI__SPRING) + (m->tensors ? peri__get_constant(b, i, PERI__VECTOR) : 0.0);
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
        peri__bond_of(m, b->f32, i, j, xi);
        if (m->tensors && (peri__get_constant(b, i, PERI__SPRING) > 0.0 || peri__get_constant(b, j, PERI__SPRING) > 0.0))
            b->central[i / PERI_LANES] = 1;
        sum += 2.0 * (own * peri__half_stiffness(b, i, j, bond) + back * peri__half_stiffness(b, j, i, bond));
        if (b->wide[j] > 0.0) sum += back * peri__gauge(b, j, xi, bond) * b->wide[j];
    }
    if (b->wide[i] > 0.0) sum += peri__lean(b, i, &row, &whole) * b->wide[i];
    b->rate[i] = sum / m->rho[m->material[i]];
}

static void peri__constants_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri_body *b = ((const peri__step *)context)->body;
    peri__row row;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        peri__read_row(b, i, &row);
        peri__set_constants(b, i, &row);
        peri__set_wide(b, i, &row);
    }
}

static void peri__rates_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri_body *b = ((const peri__step *)context)->body;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) peri__set_rate(b, i);
}

static void peri__find_fastest(peri_body *b) {
    b->fastest = 0.0;
    for (int64_t i = 0; i < b->model->points; ++i)
        if (!(b->rate[i] <= b->fastest)) b->fastest = b->rate[i]; /* NaN, too: it is refused */
}

/* Brings the constants up to date with the bonds that are left. */
static void peri__refresh(peri_body *b) {
    peri__step step;
    if (!b->stale) return;
    memset(&step, 0, sizeof step);
    step.body = b;
    if (b->central) memset(b->central, 0, (size_t)(b->model->points / PERI_LANES + 1));
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__constants_block, &step, NULL);
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__rates_block, &step, NULL);
    peri__find_fastest(b);
    b->stale = 0;
}
