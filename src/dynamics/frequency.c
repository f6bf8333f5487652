/* SPDX-License-Identifier: MIT */
/* frequency.c - the square of the highest frequency of a body at rest, estimated sharply; what stiffness.c bounds by row sums.

   A = M^-1 K, K the tangent at rest, M = rho V, is self-adjoint in the product <x, y> = sum rho V x.y. Lanczos's method takes k products
   with A, one pass of the linear forces each, from a random start and finds the largest and least eigenvalue T and t of A on what they
   span. T never exceeds the largest eigenvalue L of A. For a start that is evenly distributed on the unit sphere of the n degrees of
   freedom (Kuczynski, Wozniakowski 1992, Theorem 4.2; A is moved by its least eigenvalue l, to which Lanczos's method is blind)

       P(L - T > e (L - l)) <= 1.648 sqrt(n) exp(-(2k - 1) sqrt(e)),

   and the same of t - l. Where both hold, T - t >= (1 - 2e) (L - l), so L <= T + e/(1 - 2e) (T - t): that is taken, with k such that it
   fails for one start in 10^6. Rounding makes the vectors lose their orthogonality, which yields copies of eigenvalues that were
   found but none beyond them, and leaves T as good (Paige 1980).
     Proven: the bound, for a start drawn anew. Not proven: anything about the one start that all bodies have, which is fixed so that
   equal bodies have equal steps; it knows nothing of any body, so bodies play the part of the draw.
     A body in several parts, or one that k products exhaust, is no special case.

   At rest is not in motion: see stretched.c.

   The estimate outlasts changes of the bonds that can only lower L: those of a body all of whose laws are pairwise, with no negative
   weight, where every bond adds a square to the energy. It is then made of the bonds that are not initially cut. Of other bodies it is
   made of the bonds as they are, if none can break: cuts make it stale. Where they can, a point may get stiffer by what it loses, the
   step would have to follow within the run, and the bound of stiffness.c, which does, stands. So it does for the centroid rule, whose A
   is not self-adjoint. A run that needs the estimate and has no memory for it fails: with the bound it would be another one. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_LANCZOS_MARGIN 0.06  /* e: 3 % of the step, for 35 products of small bodies, 50 of large ones                 */
#define PERI_LANCZOS_SLACK  (1.0 + PERI_LANCZOS_MARGIN / (1.0 - 2.0 * PERI_LANCZOS_MARGIN)) /* over T, where t = 0          */
#define PERI_LANCZOS_CHANCE 1e-6
#define PERI_LANCZOS_LIMIT 64     /* products, for more points than ids can number                                        */

typedef struct peri__lanczos {
    const peri_body *body;
    peri__operands   operands;
    void            *now, *before, *force; /* real [dim][stride]: two vectors of the basis; the forces of the first           */
    void            *response;             /* as body->response                                                             */
    uint16_t        *masks;                /* of the bonds that are not initially cut; NULL where body->masks or none serve  */
    double           alpha, beta, scale;
    double           diagonal[PERI_LANCZOS_LIMIT], beside[PERI_LANCZOS_LIMIT]; /* of the tridiagonal matrix                     */
} peri__lanczos;

/* ---- the tridiagonal matrix ---------------------------------------------------------------------------------------- */

/* Eigenvalues below x, by Sturm's sequence. beside[k]: between k and k + 1. */
static int peri__count_below(int n, const double *diagonal, const double *beside, double x) {
    const double least = DBL_MIN / DBL_EPSILON;
    double pivot = diagonal[0] - x;
    int below = pivot < 0.0;
    for (int k = 1; k < n; ++k) {
        if (fabs(pivot) < least) pivot = pivot < 0.0 ? -least : least;
        pivot = diagonal[k] - x - beside[k - 1] * beside[k - 1] / pivot;
        below += pivot < 0.0;
    }
    return below;
}

/* The eigenvalue with `below` others below it, by bisection of the interval that Gershgorin's circles cover. */
static double peri__bisect(int n, const double *diagonal, const double *beside, int below) {
    double lo = diagonal[0], hi = diagonal[0];
    for (int k = 0; k < n; ++k) {
        const double radius = (k > 0 ? beside[k - 1] : 0.0) + (k + 1 < n ? beside[k] : 0.0);
        if (diagonal[k] - radius < lo) lo = diagonal[k] - radius;
        if (diagonal[k] + radius > hi) hi = diagonal[k] + radius;
    }
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (lo + hi);
        if (peri__count_below(n, diagonal, beside, middle) > below) hi = middle;
        else lo = middle;
    }
    return hi;
}

/* ---- the vectors ----------------------------------------------------------------------------------------------------- */

/* Close to a normal deviate, by the sum of eight even ones, whole numbers all the way: the same on every machine. */
static double peri__deviate(uint64_t at) {
    int32_t sum = 0;
    for (uint64_t half = 0; half < 2; ++half) {
        uint64_t z = (2 * at + half + 1) * UINT64_C(0x9E3779B97F4A7C15);
        z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
        z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
        z ^= z >> 31;
        for (int part = 0; part < 64; part += 16) sum += (int32_t)(z >> part & 0xFFFF);
    }
    return (double)(sum - 4 * 0xFFFF) / 0x10000;
}

/* now = g/sqrt(rho V); sums->a: its norm. */
static void peri__lanczos_start(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__lanczos *s = (const peri__lanczos *)context;
    const peri__model *m = s->body->model;
    for (int64_t i = begin; i < end; ++i) {
        const double root = sqrt(peri__mass(s->body, i));
        for (int32_t d = 0; d < m->dim; ++d) {
            const double g = peri__deviate((uint64_t)(i * m->dim + d));
            peri__put_real(s->now, s->body->f32, d * m->stride + i, g / root);
            sums->a += g * g;
        }
    }
}

static void peri__lanczos_scale(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__lanczos *s = (const peri__lanczos *)context;
    const peri__model *m = s->body->model;
    const int32_t f32 = s->body->f32;
    (void)sums;
    for (int32_t d = 0; d < m->dim; ++d)
        for (int64_t at = d * m->stride + begin; at < d * m->stride + end; ++at)
            peri__put_real(s->now, f32, at, s->scale * peri__get_real(s->now, f32, at));
}

/* sums->a: <now, A now>. */
static void peri__lanczos_dot(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__lanczos *s = (const peri__lanczos *)context;
    const peri__model *m = s->body->model;
    const int32_t f32 = s->body->f32;
    for (int64_t i = begin; i < end; ++i)
        for (int32_t d = 0; d < m->dim; ++d) {
            const int64_t at = d * m->stride + i;
            sums->a -= m->volume[i] * peri__get_real(s->now, f32, at) * peri__get_real(s->force, f32, at);
        }
}

/* before = A now - alpha now - beta before; sums->a: its norm. The force is used up. */
static void peri__lanczos_next(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__lanczos *s = (const peri__lanczos *)context;
    const peri__model *m = s->body->model;
    const int32_t f32 = s->body->f32;
    for (int64_t i = begin; i < end; ++i) {
        const double rho = peri__density_at(s->body, i);
        for (int32_t d = 0; d < m->dim; ++d) {
            const int64_t at = d * m->stride + i;
            const double next = -peri__get_real(s->force, f32, at) / rho - s->alpha * peri__get_real(s->now, f32, at)
                              - s->beta * peri__get_real(s->before, f32, at);
            peri__put_real(s->before, f32, at, next);
            peri__put_real(s->force, f32, at, 0.0);
            sums->a += rho * m->volume[i] * next * next;
        }
    }
}

/* sums->a: <before, now>. */
static void peri__lanczos_overlap(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__lanczos *s = (const peri__lanczos *)context;
    const peri__model *m = s->body->model;
    const int32_t f32 = s->body->f32;
    for (int64_t i = begin; i < end; ++i)
        for (int32_t d = 0; d < m->dim; ++d) {
            const int64_t at = d * m->stride + i;
            sums->a += peri__mass(s->body, i) * peri__get_real(s->before, f32, at) * peri__get_real(s->now, f32, at);
        }
}

static double peri__lanczos_pass(peri__lanczos *s, void (*pass)(void *, int64_t, int64_t, peri__sums *)) {
    peri__for_points(s->body, s->body->model->points, 2, pass, s, s->body->sums);
    return peri__total(s->body->sums, s->body->model->points).a;
}

/* To twelve bits: kernels that agree to the rounding of sums, which the products magnify, shall have one step. */
static double peri__round_up(double value) {
    int exponent = 0;
    const double mantissa = frexp(value, &exponent);
    return peri__finite(value) ? ldexp(ceil(mantissa * 4096.0), exponent - 12) : value;
}

/* The next vector of the basis, not scaled, to `before`; returns its size. What little the products of small bodies leave of it is made
   orthogonal to the last vector once more; 0 where it is rounding. */
static double peri__lanczos_extend(peri__lanczos *s, double size) {
    double next = sqrt(peri__lanczos_pass(s, peri__lanczos_next));
    if (next < 1e-3 * size) {
        s->alpha = peri__lanczos_pass(s, peri__lanczos_overlap);
        s->beta = -1.0; /* and the force is 0: before -= alpha now */
        next = sqrt(peri__lanczos_pass(s, peri__lanczos_next));
    }
    return next > (s->body->b32 ? 1e-5 : 1e-12) * size ? next : 0.0;
}

/* L, with its margin; what is no number where something has left the range of numbers. */
static double peri__lanczos_run(peri__lanczos *s, int products) {
    int n = 0;
    double size = 0.0;
    s->beta = 0.0;
    s->scale = 1.0 / sqrt(peri__lanczos_pass(s, peri__lanczos_start));
    for (;;) {
        (void)peri__lanczos_pass(s, peri__lanczos_scale);
        s->operands.u = s->operands.drifted = s->now;
        peri__sum_bonds(s->body, &s->operands, NULL);
        s->alpha = s->diagonal[n] = peri__lanczos_pass(s, peri__lanczos_dot);
        if (!(fabs(s->alpha) <= size)) size = fabs(s->alpha);
        if (++n == products) break;
        s->beta = s->beside[n - 1] = peri__lanczos_extend(s, size);
        if (!(s->beta > 0.0)) break; /* the products span no more */
        void *now = s->before;
        s->before = s->now;
        s->now = now;
        s->scale = 1.0 / s->beta;
    }
    const double least = peri__bisect(n, s->diagonal, s->beside, 0), most = peri__bisect(n, s->diagonal, s->beside, n - 1);
    return peri__round_up(most + (PERI_LANCZOS_SLACK - 1.0) * (most - least));
}

/* k of n degrees of freedom: 2 1.648 sqrt(n) exp(-(2k - 1) sqrt(e)) <= chance. */
static int peri__lanczos_products(double n) {
    const double k = 0.5 + 0.5 * log(2.0 * 1.648 / PERI_LANCZOS_CHANCE * sqrt(n)) / sqrt(PERI_LANCZOS_MARGIN);
    return k < PERI_LANCZOS_LIMIT ? (int)ceil(k) : PERI_LANCZOS_LIMIT;
}

/* ---- the body --------------------------------------------------------------------------------------------------------- */

/* Does every bond add a square to the energy? */
static int peri__softens(const peri_body *b) {
    const peri__model *m = b->model;
    if (!m->pairwise) return 0;
    for (int32_t k = 0; k < m->stencil.vectors; ++k)
        if (!(m->stencil.table[k].weight >= 0.0)) return 0;
    for (int64_t at = 0; m->weight && at < m->bonds; ++at)
        if (!(peri__get_real(m->weight, b->b32, at) >= 0.0)) return 0;
    return 1;
}

/* Has the body, some of whose bonds were broken or cut after the start, as if they were whole: 0 where memory is short. */
static int peri__heal_for_lanczos(peri__lanczos *s) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    if (b->now.broken == 0) return 1;
    s->operands.alive = b->uncut;
    s->operands.masks = NULL;
    if (!b->uncut || !b->masks) return 1;
    s->masks = (uint16_t *)peri__new(&b->scratch, m->stencil.columns, sizeof *s->masks);
    for (int64_t g = 0; s->masks && g < m->stencil.groups; ++g) peri__group_masks(m, g, ~(uint32_t)0, b->uncut, s->masks);
    s->operands.masks = s->masks;
    return s->masks != NULL;
}

/* The estimate of a body whose constants and masks are up to date. Below 0 where memory is short. */
static double peri__estimate_frequency(const peri_body *b) {
    const peri__model *m = b->model;
    const int64_t response = peri__response_reals(m);
    double most = -1.0;
    peri__lanczos s;
    memset(&s, 0, sizeof s);
    s.body = b;
    s.operands = peri__operands_of(b);
    s.operands.bond_laws = NULL; /* they are no stiffer than at rest                                                      */
    void *vectors[3] = { peri__new_vector(b, &b->scratch), peri__new_vector(b, &b->scratch), peri__new_vector(b, &b->scratch) };
    if (!m->pairwise) s.response = peri__new(&b->scratch, response, peri__bond_real(b));
    if (vectors[0] && vectors[1] && vectors[2] && (s.response || m->pairwise) && (!b->softens || peri__heal_for_lanczos(&s))) {
        s.now = vectors[0];
        s.before = vectors[1];
        s.force = s.operands.f = vectors[2];
        s.operands.response = s.response ? (char *)s.response + (size_t)m->margin * peri__bond_real(b) : NULL;
        s.operands.node = NULL;
        s.operands.linear = 1;
        peri__take_fields(b, &s.operands, 0);
        most = peri__lanczos_run(&s, peri__lanczos_products((double)m->points * m->dim));
    }
    for (int k = 0; k < 3; ++k) peri__delete_vector(b, &b->scratch, vectors[k]);
    peri__delete(&b->scratch, s.response, response, peri__bond_real(b));
    peri__delete(&b->scratch, s.masks, m->stencil.columns, sizeof *s.masks);
    return most;
}

/* Brings b->sharp up to date. 0 where memory is short: the bound stands until the next time. */
static int peri__sharpen(peri_body *b) {
    const peri__model *m = b->model;
    if (!(b->now.stale & PERI__STALE_SHARP)) return 1;
    b->softens = peri__softens(b);
    b->sharp = HUGE_VAL;
    if (!m->centroid && !m->part && (b->softens || !m->breakable)) { /* parts go by the bound */
        (void)peri__ensure(b, PERI__STALE_MASKS | PERI__STALE_CONSTANTS);
        const double most = peri__estimate_frequency(b);
        if (most < 0.0) return 0;
        if (most > 0.0) b->sharp = most;
    }
    b->now.stale &= ~(uint32_t)PERI__STALE_SHARP;
    return 1;
}
