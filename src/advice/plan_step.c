/* SPDX-License-Identifier: MIT */
/* plan_step.c - the stable step of a body that is only described: the bound of stiffness.c, and what frequency.c will estimate.

   A pairwise body of many cells has the highest frequency of a plane wave in a body without end: u = U exp(i k.x) makes of K the D x D
   matrix S(k), the symbol of the stencil, whose largest eigenvalue is looked for along the axes and diagonals of the lattice. Of other
   laws the stiffest modes sit at faces and corners: they are found on a box of few cells, and are to its bound as those of the scene
   are to theirs. Nothing is allocated. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_CLASS_LIMIT 256        /* kinds of places in a body whose stiffness is worked out                            */
#define PERI_WAVES 12               /* wave vectors along an axis                                                         */
#define PERI_SMALL_POINTS 216       /* of the small body                                                                  */
#define PERI_SMALL_PRODUCTS 16      /* with its stiffness: to 1 %                                                         */

/* Lengths and weights of the bonds of a whole family. */
static int32_t peri__weigh_estimate(peri__estimate *s) {
    const int32_t dim = s->model.dim;
    double total = 0.0, stiff = 0.0;
    for (int64_t k = 0; k < s->vector_count; ++k) {
        peri__bond bond;
        for (int32_t d = 0; d < dim; ++d) s->x[dim + d] = s->vector[k][d] * (s->piece.cell[d] / s->model.length);
        if (!peri__weigh_bond(&s->cloud, &s->parts, 0, 1, &bond)) return peri__fail(&s->body, PERI_ERROR_INFLUENCE, "influence", 0, 0.0);
        s->length[k] = bond.length;
        s->weight[k] = bond.weight;
        total += fabs(bond.weight);
        stiff += bond.weight * bond.length * bond.length;
    }
    const int32_t status = peri__check_weight(&s->body, total, stiff, s->model.pairwise);
    return status < 0 ? peri__fail(&s->body, status, "influence", 0, 0.0) : PERI_OK;
}

/* The point that bond k of p leads to. 0 where that is outside. */
static int peri__leads(const peri__estimate *s, const int64_t *p, int64_t k, int64_t *to) {
    for (int d = 0; d < 3; ++d) {
        to[d] = p[d] + s->vector[k][d];
        if (to[d] < 0 || to[d] >= s->n[d]) return 0;
    }
    return 1;
}

static void peri__vector_of_bond(const peri__estimate *s, int64_t k, double *xi) {
    for (int d = 0; d < 3; ++d) xi[d] = d < s->model.dim ? s->vector[k][d] * (s->piece.cell[d] / s->model.length) : 0.0;
}

/* The row sum of the stiffness over rho of the bond-based point in the middle, as peri__row_sum_block has it. */
static double peri__middle_row_sum(const peri__estimate *s) {
    const int64_t middle[3] = { (s->n[0] - 1) / 2, (s->n[1] - 1) / 2, (s->n[2] - 1) / 2 };
    int64_t to[3];
    double row_sum = 0.0;
    for (int64_t k = 0; k < s->vector_count; ++k)
        if (peri__leads(s, middle, k, to)) row_sum += 2.0 * s->pair.c * fabs(s->weight[k]) / s->length[k];
    return row_sum;
}

typedef struct peri__sample { /* points that see the same faces, mirrored or not                                         */
    peri__calibration r;
    double            diagonal[3], gather_row_sum; /* g_ii and kappa R, or R: stiffness.c                                */
} peri__sample;

/* As peri__gather_vector. */
static double peri__gather_vector_of(const peri__estimate *s, const peri__sample *a, const double *xi, double bond, double *g) {
    const int32_t dim = s->model.dim;
    const peri__law *law = &s->model.laws[0];
    const double size = a->r.theta_factor * peri__law_gauge(law, bond);
    for (int32_t p = 0; p < 3; ++p) g[p] = p < dim ? size * xi[p] / bond : 0.0;
    if (!(law->gather & PERI__GRADIENT)) return size;
    for (int32_t p = 0; p < dim; ++p) {
        g[p] = 0.0;
        for (int32_t q = 0; q < dim; ++q) g[p] += a->r.shape_inverse[peri__packed(dim, p, q)] * xi[q];
    }
    return sqrt(peri__dot(g, g, dim));
}

/* kappa of a sample of an ordinary law, or 1. */
static double peri__sample_stiffness(const peri__estimate *s, const peri__sample *a) {
    if (s->model.laws[0].gather & PERI__GRADIENT) return 1.0;
    return a->r.theta_factor > 0.0 ? a->r.pressure_factor / a->r.theta_factor : 0.0;
}

/* As peri__set_constants and peri__set_gather_row_sum of the whole family of p. */
static void peri__fill_sample(const peri__estimate *s, const int64_t *p, peri__sample *a) {
    const peri__law *law = &s->model.laws[0];
    double xi[3], g[3], total = 0.0;
    int64_t to[3];
    peri__moments sum;
    memset(&sum, 0, sizeof sum);
    for (int64_t k = 0; k < s->vector_count; ++k) {
        if (!peri__leads(s, p, k, to)) continue;
        peri__vector_of_bond(s, k, xi);
        peri__add_moments(&sum, s->model.dim, xi, s->length[k], s->weight[k]);
    }
    memset(a, 0, sizeof *a);
    if (!law->pairwise && !peri__calibrate(law, s->model.dim, &sum, &a->r)) a->r.spring = sum.m > 0.0 ? law->b / sum.m : 0.0;
    for (int64_t k = 0; k < s->vector_count; ++k) {
        if (!peri__leads(s, p, k, to)) continue;
        peri__vector_of_bond(s, k, xi);
        total += fabs(s->weight[k]) * peri__gather_vector_of(s, a, xi, s->length[k], g);
        for (int d = 0; d < 3; ++d) a->diagonal[d] += s->weight[k] * g[d];
    }
    total += sqrt(peri__dot(a->diagonal, a->diagonal, 3));
    const double stiff = peri__sample_stiffness(s, a);
    a->gather_row_sum = stiff > 0.0 ? stiff * total : 0.0;
}

/* Those of one corner, in [kinds]; returns how many. */
static int64_t peri__fill_samples(const peri__estimate *s, int64_t *kinds, peri__sample *sample) {
    int64_t all = 1, p[3];
    for (int d = 0; d < 3; ++d) all *= kinds[d] = 1 + peri__min(s->span[d], (s->n[d] - 1) / 2);
    for (int64_t k = 0; k < all; ++k) {
        p[0] = k % kinds[0];
        p[1] = k / kinds[0] % kinds[1];
        p[2] = k / kinds[0] / kinds[1];
        peri__fill_sample(s, p, &sample[k]);
    }
    return all;
}

/* The point in the corner that sees the same faces as `to`; mirror: which axes are turned over. */
static int64_t peri__kind_of(const peri__estimate *s, const int64_t *kinds, const int64_t *to, double *mirror) {
    int64_t at = 0;
    for (int d = 2; d >= 0; --d) {
        const int64_t back = s->n[d] - 1 - to[d];
        mirror[d] = back < to[d] ? -1.0 : 1.0;
        at = at * kinds[d] + peri__min(kinds[d] - 1, peri__min(to[d], back));
    }
    return at;
}

/* What the point of sample a has of the bond k to one of sample c, mirrored, as in peri__set_row_sum. */
static void peri__add_bond_of(const peri__estimate *s, const peri__sample *a, const peri__sample *c, const double *mirror, int64_t k,
                              double *sum) {
    const int32_t dim = s->model.dim;
    const int even = s->body.desc.quadrature == PERI_QUADRATURE_PARTIAL_CENTROID;
    const double w = fabs(s->weight[k]), along = 2.0 * w * (a->r.spring + c->r.spring);
    double g[3], xi[3], turned[3];
    peri__vector_of_bond(s, k, xi);
    for (int d = 0; d < 3; ++d) turned[d] = mirror[d] * xi[d];
    const double round = (even ? along : 0.0) + 2.0 * w * (a->r.stabilization + c->r.stabilization);
    peri__add_stiffness(dim, even ? 0.0 : along, round, xi, s->length[k], sum);
    if (!(c->gather_row_sum > 0.0)) return;
    const double size = peri__gather_vector_of(s, c, turned, s->length[k], g);
    for (int d = 0; d < 3; ++d) g[d] *= mirror[d];
    peri__add_gathered(&s->model.laws[0], dim, even, w * c->gather_row_sum, g, size, sum);
}

/* The largest row_sum of a state-based body, as peri__set_row_sum has it. Points within a horizon of faces are the stiffest; mirrored ones
   are alike, so one corner is enough. */
static double peri__corner_row_sum(const peri__estimate *s) {
    const int even = s->body.desc.quadrature == PERI_QUADRATURE_PARTIAL_CENTROID;
    peri__sample sample[PERI_CLASS_LIMIT];
    int64_t kinds[3], p[3], to[3];
    double largest = 0.0, mirror[3];
    const int64_t all = peri__fill_samples(s, kinds, sample);
    for (int64_t k = 0; k < all; ++k) {
        const peri__sample *a = &sample[k];
        double sum[6] = { 0.0 };
        p[0] = k % kinds[0];
        p[1] = k / kinds[0] % kinds[1];
        p[2] = k / kinds[0] / kinds[1];
        for (int64_t v = 0; v < s->vector_count; ++v) {
            if (!peri__leads(s, p, v, to)) continue;
            const int64_t at = peri__kind_of(s, kinds, to, mirror);
            peri__add_bond_of(s, a, &sample[at], mirror, v, sum);
        }
        if (a->gather_row_sum > 0.0)
            peri__add_gathered(&s->model.laws[0], s->model.dim, even, a->gather_row_sum, a->diagonal,
                               sqrt(peri__dot(a->diagonal, a->diagonal, 3)), sum);
        const double row_sum = peri__largest_eigenvalue(s->model.dim, sum);
        if (row_sum > largest) largest = row_sum;
    }
    return largest;
}

/* ---- pairwise bodies: the symbol -------------------------------------------------------------------------------------- */

/* The largest eigenvalue of S(k), all points having the family of p. */
static double peri__symbol(const peri__estimate *s, const int64_t *p, const double *wave) {
    const int32_t dim = s->model.dim;
    double sum[6] = { 0.0 }, full[9], v[9], xi[3], most = 0.0;
    int64_t to[3];
    for (int64_t k = 0; k < s->vector_count; ++k) {
        if (!peri__leads(s, p, k, to)) continue;
        peri__vector_of_bond(s, k, xi);
        const double along = s->weight[k] * s->pair.c / s->length[k] * (1.0 - cos(peri__dot(wave, xi, dim)));
        peri__add_stiffness(dim, along, 0.0, xi, s->length[k], sum);
    }
    peri__eigen(dim, sum, full, v);
    for (int d = 0; d < dim; ++d)
        if (full[d * (dim + 1)] > most) most = full[d * (dim + 1)];
    return most;
}

/* Over wave vectors along axes and diagonals; the family is that of the point in the middle. */
static double peri__symbol_frequency(const peri__estimate *s) {
    const int64_t middle[3] = { (s->n[0] - 1) / 2, (s->n[1] - 1) / 2, (s->n[2] - 1) / 2 };
    double largest = 0.0;
    for (int axes = 1; axes < 1 << s->model.dim; ++axes)
        for (int k = 1; k <= PERI_WAVES; ++k) {
            double wave[3] = { 0.0, 0.0, 0.0 };
            for (int d = 0; d < 3; ++d)
                if (axes >> d & 1) wave[d] = PERI_PI * k / PERI_WAVES * (s->model.length / s->piece.cell[d]);
            const double value = peri__symbol(s, middle, wave);
            if (value > largest) largest = value;
        }
    return largest;
}

/* ---- other bodies: a small one ---------------------------------------------------------------------------------------- */

typedef struct peri__small { /* a box of few cells, at rest: 110 kB, on the stack of peri_plan                               */
    const peri__estimate *s;
    int64_t      points, at[PERI_SMALL_POINTS][3], kinds[3];
    int32_t      kind[PERI_SMALL_POINTS]; /* of points, in sample                                                        */
    peri__sample sample[PERI_CLASS_LIMIT];
    double       xi[PERI_VECTOR_LIMIT][3], gauge[PERI_VECTOR_LIMIT]; /* gauge: over the length                              */
    double       now[PERI_SMALL_POINTS][3], before[PERI_SMALL_POINTS][3], next[PERI_SMALL_POINTS][3];
    double       response[PERI_SMALL_POINTS][9];
} peri__small;

/* What point i responds with: p over |xi|^(1 - gauge), so that its half is w p xi; or Q = P K^-1 - k H. */
static void peri__small_gather(peri__small *b, int64_t i) {
    const peri__estimate *s = b->s;
    const peri__law *law = &s->model.laws[0];
    const peri__calibration *r = &b->sample[b->kind[i]].r;
    const int32_t dim = s->model.dim;
    const int tensor = (law->gather & PERI__GRADIENT) != 0;
    double n[3][3] = { { 0.0 } }, h[3][3] = { { 0.0 } }, inverse[3][3], mirror[3], theta = 0.0;
    int64_t to[3];
    for (int64_t k = 0; k < s->vector_count; ++k) {
        if (!peri__leads(s, b->at[i], k, to)) continue;
        const double *xi = b->xi[k], *far_end = b->now[to[0] + s->n[0] * (to[1] + s->n[1] * to[2])], w = s->weight[k];
        if (!tensor)
            for (int p = 0; p < dim; ++p) theta += w * b->gauge[k] * xi[p] * (far_end[p] - b->now[i][p]);
        for (int p = 0; tensor && p < dim; ++p)
            for (int q = 0; q < dim; ++q) n[p][q] += w * (far_end[p] - b->now[i][p]) * xi[q];
    }
    b->response[i][0] = r->pressure_factor * r->theta_factor * theta;
    if (!tensor) return;
    (void)peri__kind_of(s, b->kinds, b->at[i], mirror);
    for (int p = 0; p < dim; ++p)
        for (int q = 0; q < dim; ++q) inverse[p][q] = mirror[p] * mirror[q] * r->shape_inverse[peri__packed(dim, p, q)];
    for (int p = 0; p < dim; ++p)
        for (int q = 0; q < dim; ++q)
            for (int c = 0; c < dim; ++c) h[p][q] += n[p][c] * inverse[c][q];
    theta = h[0][0] + h[1][1] + h[2][2];
    for (int p = 0; p < dim; ++p)
        for (int q = 0; q < dim; ++q) {
            double sum = law->lambda * theta * inverse[p][q] - r->stabilization * h[p][q];
            for (int c = 0; c < dim; ++c) sum += law->mu * (h[p][c] + h[c][p]) * inverse[c][q];
            b->response[i][3 * p + q] = sum;
        }
}

/* next = A now at point i. */
static void peri__small_force(peri__small *b, int64_t i) {
    const peri__estimate *s = b->s;
    const int32_t dim = s->model.dim;
    const int tensor = (s->model.laws[0].gather & PERI__GRADIENT) != 0;
    const peri__calibration *own = &b->sample[b->kind[i]].r;
    double sum[3] = { 0.0, 0.0, 0.0 };
    int64_t to[3];
    for (int64_t k = 0; k < s->vector_count; ++k) {
        if (!peri__leads(s, b->at[i], k, to)) continue;
        const int64_t j = to[0] + s->n[0] * (to[1] + s->n[1] * to[2]);
        const double *xi = b->xi[k], *mine = b->response[i], *other = b->response[j], length = s->length[k];
        const peri__calibration *r = &b->sample[b->kind[j]].r;
        const double spring = s->model.pairwise ? s->pair.c / length : own->spring + r->spring;
        const double round = own->stabilization + r->stabilization;
        double eta[3] = { 0.0, 0.0, 0.0 };
        for (int p = 0; p < dim; ++p) eta[p] = b->now[j][p] - b->now[i][p];
        const double along = spring * peri__dot(eta, xi, dim) / (length * length) + (tensor ? 0.0 : (mine[0] + other[0]) * b->gauge[k]);
        for (int p = 0; p < dim; ++p) {
            double half = along * xi[p] + round * eta[p];
            for (int q = 0; tensor && q < dim; ++q) half += (mine[3 * p + q] + other[3 * p + q]) * xi[q];
            sum[p] -= s->weight[k] * half;
        }
    }
    memcpy(b->next[i], sum, sizeof sum);
}

/* The largest eigenvalue of the small body, all points having one mass: Lanczos's method, as in frequency.c. */
static double peri__small_frequency(const peri__estimate *s) {
    peri__small b;
    double diagonal[PERI_SMALL_PRODUCTS], beside[PERI_SMALL_PRODUCTS], beta = 0.0, mirror[3];
    const int32_t dim = s->model.dim;
    int n = 0;
    b.s = s;
    b.points = s->model.points;
    peri__fill_samples(s, b.kinds, b.sample);
    double norm = 0.0;
    for (int64_t k = 0; k < s->vector_count; ++k) {
        peri__vector_of_bond(s, k, b.xi[k]);
        b.gauge[k] = peri__law_gauge(&s->model.laws[0], s->length[k]) / s->length[k];
    }
    for (int64_t i = 0; i < b.points; ++i) {
        b.at[i][0] = i % s->n[0];
        b.at[i][1] = i / s->n[0] % s->n[1];
        b.at[i][2] = i / s->n[0] / s->n[1];
        b.kind[i] = (int32_t)peri__kind_of(s, b.kinds, b.at[i], mirror);
        for (int d = 0; d < 3; ++d) {
            b.now[i][d] = d < dim ? peri__deviate((uint64_t)(3 * i + d)) : 0.0;
            b.before[i][d] = 0.0;
            norm += peri__square(b.now[i][d]);
        }
    }
    for (;;) {
        const double scale = 1.0 / sqrt(norm);
        double alpha = 0.0;
        for (int64_t i = 0; i < b.points; ++i)
            for (int d = 0; d < 3; ++d) b.now[i][d] *= scale;
        for (int64_t i = 0; i < b.points; ++i) peri__small_gather(&b, i);
        for (int64_t i = 0; i < b.points; ++i) peri__small_force(&b, i);
        for (int64_t i = 0; i < b.points; ++i) alpha += peri__dot(b.now[i], b.next[i], dim);
        diagonal[n++] = alpha;
        norm = 0.0;
        for (int64_t i = 0; i < b.points; ++i)
            for (int d = 0; d < 3; ++d) {
                const double next = b.next[i][d] - alpha * b.now[i][d] - beta * b.before[i][d];
                b.before[i][d] = b.now[i][d];
                b.now[i][d] = next;
                norm += next * next;
            }
        beta = beside[n - 1] = sqrt(norm);
        if (n == PERI_SMALL_PRODUCTS || !(beta > 1e-6 * fabs(alpha))) break;
    }
    return peri__bisect(n, diagonal, beside, n - 1);
}
