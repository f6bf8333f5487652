/* SPDX-License-Identifier: MIT */
/* balance.c - weights for which a uniform strain is in equilibrium inside, on any cloud: PERI_CORRECTION_EQUILIBRIUM.

   One-point quadrature misses the balance of forces where families are not symmetric about their points. Under the strain eps point i gets,
   times its volume,
       F_i = sum_j (mu_ij x_ij + mu_ji x_ji)/|xi| (n.eps.n) n + ...,   mu_ij = V_i w |xi|^2 V_j/m_i,   n = xi/|xi|,
   where x_ij is the factor on i's half of the bond, and the rest, of the pressure, is a trace of the same; bonds between bond-based points
   have one factor, w |xi| in the place of w |xi|^2, and the m of the full horizon. So the third moment
       b_i = sum_j (mu_ij x_ij + mu_ji x_ji)/|xi| n n n
   has to vanish at each point inside, for every strain at once, while the fourth moment
       a_i = sum_j mu_ij x_ij n n n n = V_i I
   stays what correction.c fits; between bond-based points, whose bonds have one factor for both ends, its trace, which is m, and the rest
   nearly, as the energy (a_i - V_i I)^2/soft has it. Of all factors x_ij = x0_ij (1 + e_ij) that do this, those nearest to x0 are taken, by
   the least sum mu x0 e^2 and of that: then e_ij = A_i.n^4 + (B_i - B_j).n^3/|xi| with a multiplier A_i and, of points inside, B_i, which
   solve a symmetric system that is as large as the body: conjugate gradients, with the blocks of the points as preconditioner. Points whose
   family lacks much of the full horizon keep their fourth moment alone: near surfaces a uniform strain needs tractions.

   Rejected: a rule of each point alone, since b_i takes from what both ends give; factors >= 0 by force, for which the system would not be
   linear: the log tells where some are below. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_CUBICS      10   /* components of a symmetric tensor of rank 3 that differ: 4 in 2D                             */
#define PERI_MULTIPLIERS (PERI_QUARTICS + PERI_CUBICS)
#define PERI_INSIDE      0.8  /* of the full horizon, which the family of a point inside has                                 */
#define PERI_BALANCED    1e-12 /* of the volume of a point: what may be left of a_i - V_i I and b_i, in the mean             */
#define PERI_STALLED     200  /* rounds of conjugate gradients that do not halve the residual: there are no such weights   */

/* The tensor n n n by its components, each times the root of how often it occurs, as peri__quartics. */
static void peri__cubics(int32_t dim, const double *n, double *component) {
    static const double root[4][4] = { { 1.0, 1.7320508075688772, 1.7320508075688772, 1.0 },
                                       { 1.7320508075688772, 2.449489742783178, 1.7320508075688772, 0.0 },
                                       { 1.7320508075688772, 1.7320508075688772, 0.0, 0.0 },
                                       { 1.0, 0.0, 0.0, 0.0 } };
    double power[3][4];
    for (int d = 0; d < 3; ++d) {
        power[d][0] = 1.0;
        for (int k = 1; k < 4; ++k) power[d][k] = power[d][k - 1] * n[d];
    }
    for (int p = 3; p >= 0; --p)
        for (int q = 3 - p; q >= (dim == 2 ? 3 - p : 0); --q) *component++ = root[p][q] * power[0][p] * power[1][q] * power[2][3 - p - q];
}

typedef struct peri__balancer {
    const peri__fitter *fitter;
    int      quartics, cubics, terms; /* of a point: those of A, of B, both                                              */
    double  *mu;       /* [entries] mu x0                                                                                */
    int32_t *mirror;   /* [entries] which bond of the row of the other end this is                                       */
    uint8_t *inside;   /* [points]                                                                                       */
    float   *block;    /* [points][terms (terms + 1)/2] Cholesky's factor of the block of a point, lower, by rows        */
    double  *lambda, *r, *z, *p, *q; /* [points][terms] multipliers; residual, the same preconditioned, direction, its image */
    double   soft;     /* how soft the fourth moments are, over the volume; their trace, which is m, never               */
    double   isotropic[PERI_QUARTICS]; /* I over its length                                                              */
    double   step;     /* along p, or of p                                                                               */
} peri__balancer;

typedef struct peri__balance_bond { /* bond `at` of i                                                                     */
    int64_t j, back; /* its other end, and the entry there                                                               */
    double  n[3], quartic[PERI_QUARTICS], cubic[PERI_CUBICS]; /* n^4; n^3/|xi|, over the spacing                         */
} peri__balance_bond;

static void peri__see_bond(const peri__balancer *s, int64_t i, int64_t at, peri__balance_bond *bond) {
    const peri__cloud *c = s->fitter->cloud;
    const peri__model *m = c->model;
    double length = 0.0;
    bond->j = m->ids[at];
    bond->back = m->start[bond->j] + s->mirror[at];
    bond->n[2] = 0.0;
    for (int32_t d = 0; d < m->dim; ++d) {
        bond->n[d] = c->x[bond->j * m->dim + d] - c->x[i * m->dim + d];
        length += bond->n[d] * bond->n[d];
    }
    length = sqrt(length);
    for (int32_t d = 0; d < m->dim; ++d) bond->n[d] /= length;
    (void)peri__quartics(m->dim, bond->n, bond->quartic);
    peri__cubics(m->dim, bond->n, bond->cubic);
    for (int k = 0; k < s->cubics; ++k) bond->cubic[k] *= m->spacing / length;
}

/* e of the own half, and of the other, under the multipliers `lambda`. */
static void peri__balance_factors(const peri__balancer *s, int64_t i, const peri__balance_bond *bond, const double *lambda, double *own,
                                  double *other) {
    const double *here = &lambda[i * s->terms], *there = &lambda[bond->j * s->terms];
    double both = 0.0, a = 0.0, c = 0.0;
    for (int k = 0; k < s->quartics; ++k) {
        a += here[k] * bond->quartic[k];
        c += there[k] * bond->quartic[k];
    }
    for (int k = 0; k < s->cubics; ++k) both += (here[s->quartics + k] - there[s->quartics + k]) * bond->cubic[k];
    if (s->fitter->cloud->model->pairwise) a = c = 0.5 * (a + c);
    *own = a + both;
    *other = c + both;
}

/* q = the moments of the factors e that p makes. sums->a: p.q */
static void peri__balance_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    const peri__model *m = s->fitter->cloud->model;
    peri__balance_bond bond;
    for (int64_t i = begin; i < end; ++i) {
        double *q = &s->q[i * s->terms];
        const double *p = &s->p[i * s->terms], trace = peri__dot(p, s->isotropic, s->quartics);
        for (int k = 0; k < s->terms; ++k)
            q[k] = k < s->quartics ? s->soft * m->volume[i] * (p[k] - trace * s->isotropic[k]) : 0.0;
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at) {
            double own, other;
            peri__see_bond(s, i, at, &bond);
            peri__balance_factors(s, i, &bond, s->p, &own, &other);
            own *= s->mu[at];
            other *= s->mu[bond.back];
            for (int k = 0; k < s->quartics; ++k) q[k] += own * bond.quartic[k];
            for (int k = 0; s->inside[i] && k < s->cubics; ++k) q[s->quartics + k] += (own + other) * bond.cubic[k];
        }
        sums->a += peri__dot(q, p, s->terms);
    }
}

/* Is the family of i as whole as one inside, and all of one material? */
static int peri__is_inside(const peri__fitter *f, int64_t i) {
    const peri__model *m = f->cloud->model;
    for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at)
        if (m->material[m->ids[at]] != m->material[i]) return 0;
    return m->volume[i] + peri__family_volume(m, i) >= PERI_INSIDE * f->whole;
}

/* mu, without x0, and the mirrors. sums->n: bonds of negative weight. */
static void peri__balance_weights(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    const peri__fitter *f = s->fitter;
    const peri__model *m = f->cloud->model;
    for (int64_t i = begin; i < end; ++i) {
        double n[3], total = 0.0;
        for (int64_t k = 0; k < m->count[i]; ++k) {
            const int64_t at = m->start[i] + k;
            total += s->mu[at] = peri__stiff(f, i, k, n);
            s->mirror[at] = (int32_t)peri__find_listed(m, m->ids[at], i);
            sums->n += s->mu[at] < 0.0;
        }
        if (m->laws[m->material[i]].pairwise) total = f->full;
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at) s->mu[at] *= m->volume[i] / total;
        s->inside[i] = (uint8_t)peri__is_inside(f, i);
    }
}

/* mu x0; bonds between bond-based points take the mean of both halves, as they will. */
static void peri__balance_start(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    const peri__model *m = s->fitter->cloud->model;
    const double *x = s->fitter->factor;
    (void)sums;
    for (int64_t i = begin; i < end; ++i)
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at)
            s->mu[at] *= m->pairwise ? 0.5 * (x[at] + x[m->start[m->ids[at]] + s->mirror[at]]) : x[at];
}

/* Cholesky's factor of a block; pivots that are not positive are left out, as peri__solve does. */
static void peri__balance_factor(int terms, double *g, float *out) {
    double none[PERI_MULTIPLIERS] = { 0.0 };
    peri__solve(terms, PERI_MULTIPLIERS, g, none, none);
    for (int row = 0; row < terms; ++row)
        for (int k = 0; k <= row; ++k) *out++ = (float)g[row * PERI_MULTIPLIERS + k];
}

/* What is missing, to r, and the factors of the blocks. */
static void peri__balance_rows(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    const peri__model *m = s->fitter->cloud->model;
    const int whole = s->terms * (s->terms + 1) / 2;
    const double half = m->pairwise ? 0.5 : 1.0;
    peri__balance_bond bond;
    (void)sums;
    for (int64_t i = begin; i < end; ++i) {
        double g[PERI_MULTIPLIERS * PERI_MULTIPLIERS] = { 0.0 }, *r = &s->r[i * s->terms], trace = 0.0;
        double *b = r + s->quartics;
        peri__isotropic_quartic(m->dim, r);
        for (int k = 0; k < s->quartics; ++k) r[k] *= s->inside[i] ? m->volume[i] : 0.0;
        for (int k = 0; k < s->cubics; ++k) b[k] = 0.0;
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at) {
            peri__see_bond(s, i, at, &bond);
            const double own = s->mu[at], both = s->inside[i] ? own + s->mu[bond.back] : 0.0;
            for (int k = 0; k < s->quartics; ++k) {
                if (s->inside[i]) r[k] -= own * bond.quartic[k];
                for (int c = 0; c <= k; ++c) g[k * PERI_MULTIPLIERS + c] += half * own * bond.quartic[k] * bond.quartic[c];
            }
            for (int k = 0; both != 0.0 && k < s->cubics; ++k) {
                double *row = &g[(s->quartics + k) * PERI_MULTIPLIERS];
                b[k] -= both * bond.cubic[k];
                for (int c = 0; c < s->quartics; ++c) row[c] += own * bond.cubic[k] * bond.quartic[c];
                for (int c = 0; c <= k; ++c) row[s->quartics + c] += both * bond.cubic[k] * bond.cubic[c];
            }
        }
        for (int k = 0; k < s->terms; ++k) trace += g[k * (PERI_MULTIPLIERS + 1)];
        for (int k = 0; k < s->quartics; ++k) g[k * (PERI_MULTIPLIERS + 1)] += s->soft * m->volume[i];
        for (int k = 0; k < s->quartics + (s->inside[i] ? s->cubics : 0); ++k) g[k * (PERI_MULTIPLIERS + 1)] += 1e-6 * trace;
        peri__balance_factor(s->terms, g, &s->block[i * whole]);
    }
}

/* z = the inverses of the blocks times r. sums->a: r.z, b: |r|^2 */
static void peri__balance_precondition(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    const int terms = s->terms;
    for (int64_t i = begin; i < end; ++i) {
        const float *l = &s->block[i * (terms * (terms + 1) / 2)];
        const double *r = &s->r[i * terms];
        double *z = &s->z[i * terms];
        for (int k = 0; k < terms; ++k) {
            double sum = r[k];
            for (int c = 0; c < k; ++c) sum -= (double)l[k * (k + 1) / 2 + c] * z[c];
            z[k] = l[k * (k + 3) / 2] > 0.0f ? sum / (double)l[k * (k + 3) / 2] : 0.0;
        }
        for (int k = terms - 1; k >= 0; --k) {
            double sum = z[k];
            for (int c = k + 1; c < terms; ++c) sum -= (double)l[c * (c + 1) / 2 + k] * z[c];
            z[k] = l[k * (k + 3) / 2] > 0.0f ? sum / (double)l[k * (k + 3) / 2] : 0.0;
        }
        sums->a += peri__dot(r, z, terms);
        sums->b += peri__dot(r, r, terms);
    }
}

static void peri__balance_turn(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    (void)sums;
    for (int64_t k = begin * s->terms; k < end * s->terms; ++k) s->p[k] = s->z[k] + s->step * s->p[k];
}

static void peri__balance_advance(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    (void)sums;
    for (int64_t k = begin * s->terms; k < end * s->terms; ++k) {
        s->lambda[k] += s->step * s->p[k];
        s->r[k] -= s->step * s->q[k];
    }
}

/* x = x0 (1 + e). sums->n: factors below 0. */
static void peri__balance_take(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__balancer *s = (const peri__balancer *)context;
    const peri__model *m = s->fitter->cloud->model;
    double *x = s->fitter->factor;
    peri__balance_bond bond;
    for (int64_t i = begin; i < end; ++i)
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at) {
            double own, other;
            peri__see_bond(s, i, at, &bond);
            peri__balance_factors(s, i, &bond, s->lambda, &own, &other);
            x[at] *= 1.0 + own;
            sums->n += x[at] < 0.0;
        }
}

/* Conjugate gradients; 1 where they have converged. */
static int peri__balance_solve(const peri_body *b, peri__balancer *s, peri__sums *sums) {
    const peri__model *m = s->fitter->cloud->model;
    const int64_t work = 8 * (int64_t)m->width;
    double volume = 0.0, rz = 0.0, best = HUGE_VAL;
    for (int64_t i = 0; i < m->points; ++i) volume += m->volume[i] * m->volume[i];
    for (int round = 0, since = 0; round < since + PERI_STALLED; ++round) {
        peri__for_points(b, m->points, s->terms, peri__balance_precondition, s, sums);
        const peri__sums now = peri__total(sums, m->points);
        if (now.b <= peri__square(PERI_BALANCED) * volume) return 1;
        if (!(now.a > 0.0)) return 0;
        if (now.b < 0.25 * best) {
            best = now.b;
            since = round;
        }
        s->step = round > 0 ? now.a / rz : 0.0;
        rz = now.a;
        peri__for_points(b, m->points, 1, peri__balance_turn, s, sums);
        peri__for_points(b, m->points, work, peri__balance_block, s, sums);
        const double curved = peri__total(sums, m->points).a;
        if (!(curved > 0.0)) return 0;
        s->step = rz / curved;
        peri__for_points(b, m->points, 1, peri__balance_advance, s, sums);
    }
    return 0;
}

/* What follows takes beside the factors. */
static int64_t peri__balance_bytes(int64_t points, int64_t entries, int32_t dim) {
    const int64_t terms = dim == 2 ? 9 : PERI_MULTIPLIERS;
    return (int64_t)(peri__scratch_bytes(entries, sizeof(double)) + peri__scratch_bytes(entries, sizeof(int32_t))
                     + peri__scratch_bytes(points, 1) + peri__scratch_bytes(points * (terms * (terms + 1) / 2), sizeof(float))
                     + peri__scratch_bytes(5 * points * terms, sizeof(double)));
}

/* Turns the factors of correction.c into those of the equilibrium. Where there are none, they stay. */
static int32_t peri__balance_weights_of(peri_body *b, const peri__fitter *f, peri__sums *sums) {
    const peri__model *m = f->cloud->model;
    const int64_t entries = m->entries, points = m->points;
    peri__balancer s;
    int32_t status = PERI_OK;
    memset(&s, 0, sizeof s);
    s.fitter = f;
    s.quartics = m->dim == 2 ? 5 : PERI_QUARTICS;
    s.soft = m->pairwise ? PERI_FIT_SOFT : 0.0;
    peri__isotropic_quartic(m->dim, s.isotropic);
    const double length = sqrt(peri__dot(s.isotropic, s.isotropic, s.quartics));
    for (int k = 0; k < s.quartics; ++k) s.isotropic[k] /= length;
    s.cubics = m->dim == 2 ? 4 : PERI_CUBICS;
    s.terms = s.quartics + s.cubics;
    const int64_t reals = points * s.terms, whole = points * (s.terms * (s.terms + 1) / 2);
    s.mu = (double *)peri__new(&b->scratch, entries, sizeof *s.mu);
    s.mirror = (int32_t *)peri__new(&b->scratch, entries, sizeof *s.mirror);
    s.inside = (uint8_t *)peri__new(&b->scratch, points, 1);
    s.block = (float *)peri__new(&b->scratch, whole, sizeof *s.block);
    s.lambda = (double *)peri__new(&b->scratch, 5 * reals, sizeof *s.lambda);
    if (!s.mu || !s.mirror || !s.inside || !s.block || !s.lambda) {
        status = peri__fail(b, PERI_ERROR_MEMORY, "correction", -1, 0.0);
    } else {
        s.r = s.lambda + reals;
        s.z = s.r + reals;
        s.p = s.z + reals;
        s.q = s.p + reals;
        peri__for_points(b, points, 8 * m->width, peri__balance_weights, &s, sums);
        const int64_t negative = peri__total(sums, points).n;
        peri__for_points(b, points, m->width, peri__balance_start, &s, sums);
        peri__for_points(b, points, 64 * m->width, peri__balance_rows, &s, sums);
        if (negative > 0 || !peri__balance_solve(b, &s, sums)) {
            peri__log(b, 1, "equilibrium correction: these families have no such weights; those of the moment correction are taken");
        } else {
            peri__for_points(b, points, 8 * m->width, peri__balance_take, &s, sums);
            if (peri__total(sums, points).n > 0) peri__log(b, 0, "equilibrium correction: some bonds have negative weights");
        }
    }
    peri__delete(&b->scratch, s.mu, entries, sizeof *s.mu);
    peri__delete(&b->scratch, s.mirror, entries, sizeof *s.mirror);
    peri__delete(&b->scratch, s.inside, points, 1);
    peri__delete(&b->scratch, s.block, whole, sizeof *s.block);
    peri__delete(&b->scratch, s.lambda, 5 * reals, sizeof *s.lambda);
    return status;
}
