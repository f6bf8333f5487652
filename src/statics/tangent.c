/* SPDX-License-Identifier: MIT */
/* tangent.c - the tangent stiffness: its product with a vector, and the blocks on its diagonal. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* t->q = the change of the force density of all bonds when the displacements change by t->p. at_rest: as if the body were undeformed;
   there, and where the geometry is linear, the force itself is linear in u and its fast kernels serve. Else body->response must be that of
   body->u. */
static void peri__apply_tangent(const peri__tangent *t, int at_rest) {
    const peri_body *b = t->body;
    const peri__model *m = b->model;
    peri__operands operands = peri__operands_of(b);
    void *change = t->change ? (char *)t->change + (size_t)m->margin * peri__bond_real(b) : NULL;
    const int32_t inelastic = at_rest ? 0 : m->inelastic;
    if (t->u) operands.u = t->u;
    if (operands.bond_laws && !at_rest) {
        operands.p = t->p;
        operands.q = t->q;
        operands.secant = t->secant;
        peri__for_points(b, m->points, 2 * m->width, b->ops->law_tangent, &operands, b->sums);
        peri__note_laws(b);
        return;
    }
    operands.bond_laws = NULL;
    const void *u = operands.u;
    operands.past.moduli = t->moduli;
    if (inelastic & PERI__OWN_STRESS) operands.past.raw = m->past.raw;
    operands.p = t->p;
    if (t->response) operands.response = (char *)t->response + (size_t)m->margin * peri__bond_real(b);
    if (at_rest || b->desc.geometry == PERI_GEOMETRY_LINEAR) {
        operands.u = t->p; /* the same bonds with other displacements */
        operands.f = t->q;
        operands.response = change;
        operands.node = NULL;
        operands.linear = 1;
        peri__take_fields(b, &operands, 0);
        memset(t->q, 0, (size_t)(m->stride * m->dim) * peri__real(b));
        peri__sum_bonds(b, &operands, NULL);
        if (inelastic & PERI__FLOWS) peri__add_flow_change(b, u, t->p, t->step, t->q);
        return;
    }
    operands.q = t->q;
    operands.change = change;
    if (m->gathers) peri__for_points(b, m->points, 2 * m->width, b->ops->tangent_gather, &operands, NULL);
    if (operands.past.raw) peri__own_changes(b, &operands, change);
    peri__for_points(b, m->points, 2 * m->width, b->ops->tangent_force, &operands, NULL);
    if (inelastic & PERI__FLOWS) peri__add_flow_change(b, u, t->p, t->step, t->q);
}

/* K^-1 of a correspondence point times v; returns v.K^-1 v. */
static double peri__by_inverse(const peri_body *b, int64_t i, const double *v, double *out) {
    const int32_t dim = b->model->dim;
    for (int a = 0; a < dim; ++a) {
        out[a] = 0.0;
        for (int c = 0; c < dim; ++c) out[a] += peri__get_constant(b, i, PERI__SHAPE_INVERSE + peri__packed(dim, a, c)) * v[c];
    }
    return peri__dot(out, v, dim);
}

/* block += scale v v + round 1 */
static void peri__add_dyad(int32_t dim, double scale, const double *v, double round, double *block) {
    for (int a = 0; a < dim; ++a)
        for (int c = a; c < dim; ++c) block[peri__packed(dim, a, c)] += scale * v[a] * v[c] + (a == c ? round : 0.0);
}

/* The diagonal block of point i, force per displacement, packed: of the bonds as they stand, without what their tension adds, so that it
   is never negative; correspondence as at rest. For a body at rest, or of linear geometry, exactly that of the tangent. Returns 0 where a
   law of bonds failed. */
static int peri__diagonal_block(const peri_body *b, int64_t i, double *block) {
    const peri__model *m = b->model;
    const int32_t dim = m->dim;
    peri__law room, other;
    const peri__law *own_law = peri__law_at(b, i, &room);
    const int linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    double gather_diagonal[3] = { 0.0 }, h[3] = { 0.0 }, whole = 0.0;
    peri__bunch bunch;
    peri__row row;
    peri__read_row(b, i, &row);
    bunch.point = -1;
    bunch.failed = bunch.asked = 0;
    for (int k = 0; k < PERI_PACKED(dim); ++k) block[k] = 0.0;
    for (int64_t k = 0; k < row.count; ++k) {
        const int64_t j = row.ids[k];
        const peri__law *law = peri__law_at(b, j, &other);
        double own = peri__weight_of(m, i, row.weight, k), back = peri__weight_of(m, i, row.back, k), xi[3] = { 0.0 }, n[3] = { 0.0 };
        double bond = peri__get_real(row.bond, b->b32, k), length = 0.0, spring = 0.0, round = 0.0, by = back * m->volume[i] / m->volume[j];
        if (!peri__is_alive(b, i, k)) continue;
        for (int32_t d = 0; d < dim; ++d) {
            int64_t from = d * m->stride + i, to = d * m->stride + j;
            xi[d] = peri__get_real(m->x, b->f32, to) - peri__get_real(m->x, b->f32, from);
            n[d] = xi[d] + (linear ? 0.0 : peri__get_real(b->u, b->f32, to) - peri__get_real(b->u, b->f32, from));
            length += n[d] * n[d];
        }
        length = sqrt(length) + DBL_MIN;
        for (int32_t d = 0; d < dim; ++d) n[d] /= length;
        spring += own * peri__spring(b, i, j, bond);
        spring += back * peri__spring(b, j, i, bond);
        if (m->law_of) {
            double force, slope;
            peri__ask_bond(b, i, &row, k, &bunch, &force, &slope);
            spring *= peri__secant(peri__stretch(b, i, &row, k), force, slope);
        }
        for (int d = 0; own_law->gather == PERI__DILATATION && d < dim; ++d)
                gather_diagonal[d] += own * peri__law_gauge(own_law, bond) * n[d];
        if (law->gather == PERI__DILATATION) { /* theta of j */
            double gauge = peri__law_gauge(law, bond);
            spring += peri__get_constant(b, j, PERI__PRESSURE_FACTOR)
                    * peri__get_constant(b, j, PERI__THETA_FACTOR) * back * by * gauge * gauge;
        }
        if (law->gather & PERI__GRADIENT) { /* F of j, and its distance from z = 0 */
            double pulled[3], square = peri__by_inverse(b, j, xi, pulled), size = peri__dot(pulled, pulled, dim);
            double lambda = law->lambda, mu = law->mu;
            peri__add_dyad(dim, m->volume[i] * back * by * (lambda + mu), pulled, m->volume[i] * back * by * mu * size, block);
            round += back * peri__get_constant(b, j, PERI__STABILIZATION) * (1.0 - by * square);
        }
        if (own_law->gather & PERI__GRADIENT) {
            whole += own;
            for (int d = 0; d < dim; ++d) gather_diagonal[d] += own * xi[d];
        }
        peri__add_dyad(dim, m->volume[i] * spring, n, m->volume[i] * round, block);
    }
    if (own_law->gather == PERI__DILATATION) {
        const double stiff = peri__get_constant(b, i, PERI__PRESSURE_FACTOR) * peri__get_constant(b, i, PERI__THETA_FACTOR);
        peri__add_dyad(dim, m->volume[i] * stiff, gather_diagonal, 0.0, block);
    }
    if (own_law->gather & PERI__GRADIENT) {
        double square = peri__by_inverse(b, i, gather_diagonal, h), lambda = own_law->lambda, mu = own_law->mu;
        peri__add_dyad(dim, m->volume[i] * (lambda + mu), h,
                       m->volume[i] * (mu * peri__dot(h, h, dim)
                                      + peri__get_constant(b, i, PERI__STABILIZATION) * (whole - square)), block);
    }
    return !bunch.failed;
}

typedef struct peri__diagonal {
    peri_body *body;
    void      *blocks; /* real [packed][stride]                                                                          */
} peri__diagonal;

static void peri__diagonal_rows(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__diagonal *t = (const peri__diagonal *)context;
    const peri__model *m = t->body->model;
    for (int64_t i = begin; i < end; ++i) {
        double block[6];
        if (!peri__diagonal_block(t->body, i, block) && sums->bad < 0) sums->bad = i;
        for (int k = 0; k < PERI_PACKED(m->dim); ++k) peri__put_real(t->blocks, t->body->f32, k * m->stride + i, block[k]);
        for (int d = 0; d < m->dim; ++d) sums->a += block[d] / m->dim;
    }
}

/* Fills ->blocks; returns the mean of the diagonal. */
static double peri__fill_diagonal(peri_body *b, void *blocks) {
    peri__diagonal t;
    t.body = b;
    t.blocks = blocks;
    peri__for_points(b, b->model->points, 4 * b->model->width, peri__diagonal_rows, &t, b->sums);
    peri__note_laws(b);
    return peri__total(b->sums, b->model->points).a / (double)b->model->points;
}

/* ---- the product in the user's units ------------------------------------------------------------------------------ */

/* The largest of `most` and the sizes of count numbers, by their bits without the sign: these ascend with the size, and to infinity and
   beyond where there is no number. */
static uint64_t peri__largest_bits(const double *in, int64_t count, uint64_t most) {
    for (int64_t k = 0; k < count; ++k) {
        uint64_t bits;
        memcpy(&bits, &in[k], sizeof bits);
        bits &= UINT64_MAX >> 1;
        most = bits > most ? bits : most;
    }
    return most;
}

/* The largest size of count numbers, of a part of those of its own points; *wrong: the first that is not finite, or -1. */
static double peri__largest(const peri__domain *part, const double *in, int64_t count, int64_t *wrong) {
    const uint64_t infinite = UINT64_C(0x7ff) << 52;
    const int64_t dim = part ? count / part->points : 0;
    uint64_t most = part ? 0 : peri__largest_bits(in, count, 0);
    double largest;
    for (int64_t i = 0; part && i < part->points - part->desc.ghost_count; ++i)
        most = peri__largest_bits(&in[part->owned[i] * dim], dim, most);
    *wrong = -1;
    for (int64_t k = 0; most >= infinite && *wrong < 0; ++k)
        if (!peri__finite(in[k]) && !(part && part->depth[k / dim])) *wrong = k;
    memcpy(&largest, &most, sizeof largest);
    return largest;
}

typedef struct peri__product { /* a product in the user's units                                                          */
    peri__tangent t;
    const double *in;
    double       *out;
    double        scale, unit; /* of the vector, a power of two; of stiffness                                            */
} peri__product;

/* Interleaved reals of the user to planes of the body, and K u of planes back. */
static void peri__to_planes(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__product *product = (const peri__product *)context;
    const peri_body *b = product->t.body;
    const double factor = 1.0 / product->scale;
    (void)sums;
    for (int32_t d = 0; d < b->dim; ++d) {
        double *wide = (double *)b->change_u + b->model->margin + d * b->model->stride;
        float *narrow = (float *)b->change_u + b->model->margin + d * b->model->stride;
        if (b->model->part)
            for (int64_t i = begin; i < end; ++i)
                peri__put_real(b->change_u, b->f32, b->model->margin + d * b->model->stride + i,
                               peri__is_ghost(b->model, i) ? 0.0 : product->in[i * b->dim + d] * factor);
        else if (b->f32)
            for (int64_t i = begin; i < end; ++i) narrow[i] = (float)(product->in[i * b->dim + d] * factor);
        else
            for (int64_t i = begin; i < end; ++i) wide[i] = product->in[i * b->dim + d] * factor;
    }
}

static void peri__from_planes(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__product *product = (const peri__product *)context;
    const peri_body *b = product->t.body;
    const double *volume = b->model->volume, scale = product->scale, unit = -product->unit;
    (void)sums;
    for (int32_t d = 0; d < b->dim; ++d) {
        const double *wide = (const double *)product->t.q + d * b->model->stride;
        const float *narrow = (const float *)product->t.q + d * b->model->stride;
        double *out = product->out + d;
        if (b->f32)
            for (int64_t i = begin; i < end; ++i) out[i * b->dim] = scale * (unit * (volume[i] * (double)narrow[i]));
        else
            for (int64_t i = begin; i < end; ++i) out[i * b->dim] = scale * (unit * (volume[i] * wide[i]));
        for (int64_t i = begin; b->model->part && i < end; ++i)
            if (b->model->part->depth[i]) out[i * b->dim] = 0.0;
    }
}

/* there: peri__multiply_there is to come, which takes the memory itself, so that a failure leaves none behind. */
static int32_t peri__check_product(peri_body *b, peri__product *product, const double *in, double *out, int64_t count, int there) {
    const peri__model *m = b->model;
    int64_t wrong;
    memset(product, 0, sizeof *product);
    PERI_NEED(b, in, "in");
    PERI_NEED(b, out, "out");
    if (count != m->points * m->dim) return peri__fail(b, PERI_ERROR_CAPACITY, "count", -1, (double)(m->points * m->dim));
    if (m->centroid) return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    product->scale = peri__largest(m->part, in, count, &wrong);
    if (wrong >= 0) return peri__fail(b, PERI_ERROR_RANGE, "in", wrong, in[wrong]);
    product->in = in;
    product->out = out;
    product->unit = m->energy / m->length / m->length;
    return there || peri__need_change(b) ? PERI_OK : peri__fail(b, PERI_ERROR_MEMORY, "out", -1, 0.0);
}

/* What is stale of `what` is made anew, and the vector gets its scale, both alike on all parts. */
static int32_t peri__open_product(peri_body *b, peri__product *product, int32_t status, uint32_t what) {
    double most[2] = { product->scale, b->now.stale & what & PERI__STALE_FORCE };
    int exponent = 0;
    status = peri__agree(b, status, 2, most);
    if (status < 0) return status;
    if (most[0] > 0.0) (void)frexp(most[0], &exponent);
    if (exponent < -1000) exponent = -1000; /* so that its inverse is a number, too */
    product->scale = ldexp(1.0, exponent - 1); /* of order one inside, whatever the size in the caller's units */
    if (most[1] > 0.0) b->now.stale |= PERI__STALE_FORCE;
    status = peri__ensure(b, what);
    return most[1] > 0.0 ? peri__agree(b, status, 0, NULL) : status;
}

static int32_t peri__multiply(peri_body *b, peri__product *product) {
    const peri__model *m = b->model;
    product->t.body = b;
    product->t.p = (char *)b->change_u + (size_t)m->margin * peri__real(b);
    product->t.q = (char *)b->change_f + (size_t)m->margin * peri__real(b);
    product->t.change = b->change_response;
    peri__for_points(b, m->points, 1, peri__to_planes, product, NULL);
    int32_t status = peri__share_vector(b, (void *)product->t.p, 0);
    if (status < 0) return status;
    peri__apply_tangent(&product->t, 0);
    status = peri__heed_laws(b);
    if (status < 0) return status;
    peri__for_points(b, m->points, 1, peri__from_planes, product, NULL);
    return PERI_OK;
}

static int32_t peri__multiply_there(peri_body *b, peri__product *product, const double *displacement);

PERI_API int32_t peri_multiply_stiffness(peri_body *b, const double *in, double *out, int64_t count) {
    peri__product product;
    PERI_NEED_CHANGEABLE(b);
    b->told = 0;
    int32_t status = peri__check_product(b, &product, in, out, count, b->model->inelastic);
    status = peri__open_product(b, &product, status, PERI__STALE_FORCE); /* the response is then that of u */
    if (status == PERI_OK && b->model->inelastic) return peri__multiply_there(b, &product, NULL);
    return peri__end_together(b, status == PERI_OK ? peri__multiply(b, &product) : status);
}

/* The displacement (NULL: that of the body) to u, and what laws respond with to it; moduli, where there are some, and flow, too. */
static int32_t peri__respond_at(peri_body *b, const double *displacement, void *u, void *response, double *moduli) {
    const peri__model *m = b->model;
    peri__operands operands = peri__operands_of(b);
    if (!displacement) memcpy(u, b->u, peri__vector_bytes(b));
    for (int64_t i = 0; displacement && i < m->points; ++i)
        for (int32_t d = 0; d < m->dim; ++d)
            peri__put_real(u, b->f32, d * m->stride + i, peri__is_ghost(m, i) ? 0.0 : displacement[i * m->dim + d] / m->length);
    const int32_t shared = peri__share_vector(b, u, 1);
    if (shared < 0) return shared;
    operands.u = u;
    operands.node = NULL;
    operands.past.moduli = moduli;
    if (moduli) operands.past.raw = m->past.raw;
    if (response) operands.response = (char *)response + (size_t)m->margin * peri__bond_real(b);
    if (m->record_reals) peri__for_points(b, m->points, 2, b->ops->fill_records, &operands, NULL);
    if (m->gathers) peri__for_points(b, m->points, m->width, b->ops->gather, &operands, NULL);
    if (moduli) (void)peri__own_stresses(b, &operands);
    if (m->inelastic & PERI__FLOWS) (void)peri__make_flow(b, u, 0.0, 0, NULL);
    return peri__heed_laws(b);
}

static int32_t peri__multiply_there(peri_body *b, peri__product *product, const double *displacement) {
    const int64_t reals = peri__response_reals(b->model), entries = peri__moduli_reals(b->model);
    int32_t status = PERI_OK;
    void *u = peri__new_vector(b, &b->scratch), *response = NULL;
    double *moduli = NULL;
    if (!b->model->pairwise) response = peri__new(&b->scratch, reals, peri__bond_real(b));
    if (entries > 0) moduli = (double *)peri__new(&b->scratch, entries, sizeof *moduli);
    if (!u || (!response && !b->model->pairwise) || (!moduli && entries > 0))
        status = peri__fail(b, PERI_ERROR_MEMORY, "displacement", -1, 0.0);
    else if (!peri__need_change(b)) status = peri__fail(b, PERI_ERROR_MEMORY, "out", -1, 0.0);
    status = peri__agree(b, status, 0, NULL);
    if (status == PERI_OK) status = peri__respond_at(b, displacement, u, response, moduli);
    if (status == PERI_OK) {
        product->t.u = u;
        product->t.response = response;
        product->t.moduli = moduli;
        status = peri__multiply(b, product);
    }
    if (b->model->inelastic & PERI__FLOWS) (void)peri__make_flow(b, b->u, 0.0, 0, NULL);
    peri__delete_vector(b, &b->scratch, u);
    peri__delete(&b->scratch, response, reals, peri__bond_real(b));
    peri__delete(&b->scratch, moduli, entries, sizeof *moduli);
    return status;
}

PERI_API int32_t peri_multiply_stiffness_at(peri_body *b, const double *displacement, const double *in, double *out, int64_t count) {
    peri__product product;
    PERI_NEED_CHANGEABLE(b);
    b->told = 0;
    const int plain = b->desc.geometry == PERI_GEOMETRY_LINEAR && !b->model->law_of && !b->model->inelastic;
    int32_t status = peri__check_product(b, &product, in, out, count, !plain);
    if (status == PERI_OK && !displacement) status = peri__fail(b, PERI_ERROR_ARGUMENT, "displacement", -1, 0.0);
    const uint8_t *ghost = b->model->part ? b->model->part->depth : NULL;
    if (status == PERI_OK) status = peri__check_state(b, b->u, displacement, count, b->model->length, "displacement", ghost);
    status = peri__open_product(b, &product, status, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
    if (status < 0) return peri__end_together(b, status);
    if (plain) status = peri__multiply(b, &product);
    else status = peri__multiply_there(b, &product, displacement);
    return peri__end_together(b, status);
}
