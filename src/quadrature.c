/* quadrature.c - families to the lengths and weights of bonds, and the bound of the highest frequency. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

static void peri__put_real(void *array, int32_t f32, int64_t at, double value) {
    if (f32) ((float *)array)[at] = (float)value;
    else ((double *)array)[at] = value;
}

static double peri__get_real(const void *array, int32_t f32, int64_t at) {
    return f32 ? (double)((const float *)array)[at] : ((const double *)array)[at];
}

/* The centroid rule made objective: beta_ij w |centroid bond|/|bond|, w at the centroid of the part of j within the horizon of i. */
static double peri__moment_weight(const peri__cloud *c, int64_t i, int64_t j, double bond, double edge) {
    double centre[3], beta = peri__part(c, i, j, centre), length = sqrt(peri__dot(centre, centre, c->model->dim));
    return beta * peri__influence(&c->body->desc, length / c->model->horizon, edge) * length / bond;
}

/* sum of beta V_j over the whole family of a point. */
static double peri__family_volume(const peri__model *m, int64_t i) {
    double sum = 0.0;
    for (int64_t k = 0; k < m->count[i]; ++k)
        sum += m->part ? (double)m->part[i * m->width + k] : m->volume[m->ids[i * m->width + k]];
    return sum;
}

/* Weights of a block of rows. sums->bad with sums->n = status. */
static void peri__weigh_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    peri__cloud *c = (peri__cloud *)context;
    const peri_body *b = c->body;
    peri__model *m = c->model;
    int32_t dim = m->dim, quadrature = b->desc.quadrature;
    double edge = 0.5 * m->spacing / m->horizon;
    peri__parts parts;
    peri__clear_parts(&parts);
    for (int64_t i = begin; i < end; ++i) {
        double total = 0.0, stiff = 0.0;
        for (int64_t k = 0; k < m->width; ++k) {
            int64_t at = i * m->width + k, j = m->ids[at];
            double xi[3], centre[3], square = 0.0, bond, length, w, beta;
            if (k >= m->count[i]) { /* padding: no weight, and a length that is safe to divide by */
                peri__put_real(m->bond, b->f32, at, 1.0);
                continue;
            }
            for (int32_t d = 0; d < dim; ++d) {
                xi[d] = c->x[j * dim + d] - c->x[i * dim + d];
                square += xi[d] * xi[d];
            }
            bond = length = sqrt(square);
            beta = peri__beta(c, &parts, i, j);
            if (quadrature == PERI_PARTIAL_CENTROID) {
                (void)peri__part(c, i, j, centre);
                length = sqrt(peri__dot(centre, centre, dim));
            }
            if (quadrature == PERI_PARTIAL_MOMENT)
                w = 0.5 * (peri__moment_weight(c, i, j, bond, edge) + peri__moment_weight(c, j, i, bond, edge));
            else
                w = beta * peri__influence(&b->desc, length / m->horizon, edge);
            if (!peri__finite(w)) {
                sums->bad = i;
                sums->n = PERI_ERROR_INFLUENCE;
                return;
            }
            w *= m->volume[j];
            if (m->part) m->part[at] = (float)(beta * m->volume[j]);
            if (m->centroid)
                for (int32_t d = 0; d < dim; ++d) peri__put_real(m->centroid, b->f32, at * dim + d, centre[d]);
            peri__put_real(m->weight, b->f32, at, w);
            if (!peri__finite(peri__get_real(m->weight, b->f32, at))) { /* beyond the range of float */
                sums->bad = i;
                sums->n = PERI_ERROR_INFLUENCE;
                return;
            }
            peri__put_real(m->bond, b->f32, at, length);
            total += fabs(w);
            stiff += w * length * length;
        }
        if (!(total > 0.0) || (m->laws[m->material[i]].model != PERI_BOND_BASED && !(stiff > 0.0))) {
            sums->bad = i;
            sums->n = total > 0.0 ? PERI_ERROR_INFLUENCE : PERI_ERROR_FAMILY;
            return;
        }
    }
}

/* sums->a: largest 2 sum(c w beta V/|xi|)/rho of a bond-based point. */
static void peri__rate_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cloud *c = (const peri__cloud *)context;
    const peri__model *m = c->model;
    for (int64_t i = begin; i < end; ++i) {
        double rate = 0.0;
        for (int64_t k = 0; k < m->count[i]; ++k) {
            int64_t at = i * m->width + k;
            rate += m->pairs[m->material[i] * m->materials + m->material[m->ids[at]]].c
                  * fabs(peri__get_real(m->weight, c->body->f32, at)) / peri__get_real(m->bond, c->body->f32, at);
        }
        rate *= 2.0 / m->rho[m->material[i]];
        if (rate > sums->a) sums->a = rate;
    }
}

static int32_t peri__weigh(peri_body *b, peri__cloud *c, peri__sums *sums) {
    peri__model *m = c->model;
    size_t real = b->f32 ? sizeof(float) : sizeof(double);
    int64_t entries = m->points * m->width;
    m->weight = peri__new(&m->memory, entries, real);
    m->bond = peri__new(&m->memory, entries, real);
    if (b->desc.quadrature != PERI_FULL_VOLUME) m->part = (float *)peri__new(&m->memory, entries, sizeof(float));
    if (b->desc.quadrature == PERI_PARTIAL_CENTROID) m->centroid = peri__new(&m->memory, entries * m->dim, real);
    if (!m->weight || !m->bond || (b->desc.quadrature != PERI_FULL_VOLUME && !m->part)
        || (b->desc.quadrature == PERI_PARTIAL_CENTROID && !m->centroid))
        return peri__fail(b, PERI_ERROR_MEMORY, "weights", -1, 0.0);
    if (b->desc.influence == PERI_INFLUENCE_USER) { /* the caller's function runs on the caller's thread */
        for (int64_t k = 0; k < m->blocks; ++k) {
            memset(&sums[k], 0, sizeof sums[k]);
            sums[k].bad = -1;
            peri__weigh_block(c, k * PERI_BLOCK, peri__min((k + 1) * PERI_BLOCK, m->points), &sums[k]);
        }
    } else {
        peri__for_points(b, m->points, 8 * m->width, peri__weigh_block, c, sums);
    }
    for (int64_t k = 0; k < m->blocks; ++k)
        if (sums[k].bad >= 0) return peri__fail(b, (int32_t)sums[k].n, "influence", sums[k].bad, 0.0);
    return PERI_OK;
}
