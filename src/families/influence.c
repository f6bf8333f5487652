/* SPDX-License-Identifier: MIT */
/* influence.c - influence functions w(q), q = |xi|/horizon, and their moments I_k = integral of w(q) q^k over [0, 1].
   A function more is its number in peri.h and its entry in the list below. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* Polynomials by ascending coefficients: their moments are sums of a_n/(n+k+1), the closed forms of [P] C.12, C.21. Values are taken
   from the same with the root at q = 1 split off, (1-q)^edge times the rest: never below 0, and exact near the horizon. */
typedef struct peri__polynomial {
    int    terms;
    double a[8];
    int    edge, rest;
    double b[4];
} peri__polynomial;

static const peri__polynomial peri__cutoff  = { 1, { 1 }, 0, 1, { 1 } };
static const peri__polynomial peri__linear  = { 2, { 1, -1 }, 1, 1, { 1 } };
static const peri__polynomial peri__cubic   = { 4, { 1, 0, -3, 2 }, 2, 2, { 1, 2 } };
static const peri__polynomial peri__quintic = { 6, { 1, 0, 0, -10, 15, -6 }, 3, 3, { 1, 3, 6 } };
static const peri__polynomial peri__septic  = { 8, { 1, 0, 0, 0, -35, 84, -70, 20 }, 4, 4, { 1, 4, 10, 20 } };
static const peri__polynomial peri__power_2 = { 3, { 1, -2, 1 }, 2, 1, { 1 } };
static const peri__polynomial peri__power_3 = { 4, { 1, -3, 3, -1 }, 3, 1, { 1 } };

/* The caller's function, on the caller's thread. Once it has failed it is not called again, and what it makes is not finite:
   peri__heed_influence turns what comes of that into the failure. */
static double peri__user_influence(peri_body *b, double q) {
    double w = 0.0;
    if (b->influence_said < 0) return (double)NAN;
    const int32_t said = b->desc.influence_fn(b->desc.influence_user, q, &w);
    if (said < 0) b->influence_said = said;
    return said < 0 ? (double)NAN : w;
}

/* The status of a call that asked influence_fn, or that this failed. */
static int32_t peri__heed_influence(peri_body *b, int32_t status) {
    const int32_t said = b->influence_said;
    b->influence_said = 0;
    return said < 0 ? peri__fail(b, PERI_ERROR_CALLBACK, "peri_influence_fn", -1, said) : status;
}

/* X(name, number, w, moment, polynomial): w of q and edge; the moment I_k of k, 0 where none is finite, or by quadrature; the polynomial
   where w is one within the horizon and 0 beyond, else NULL. */
#define PERI_BY_QUADRATURE (-1.0)
#define PERI_POLYNOMIAL_(X, name, number, p)                                                                           \
    X(name, number, peri__polynomial_value(p, q), peri__polynomial_moment(p, k), p)
#define PERI_INFLUENCE_LIST(X)                                                                                         \
    X(CONSTANT, 401, 1.0, 1.0 / (k + 1), NULL)                                                                           \
    PERI_POLYNOMIAL_(X, CUTOFF, 402, &peri__cutoff)                                                                      \
    PERI_POLYNOMIAL_(X, LINEAR, 403, &peri__linear)                                                                      \
    PERI_POLYNOMIAL_(X, CUBIC, 404, &peri__cubic)                                                                        \
    PERI_POLYNOMIAL_(X, QUINTIC, 405, &peri__quintic)                                                                    \
    PERI_POLYNOMIAL_(X, SEPTIC, 406, &peri__septic)                                                                      \
    PERI_POLYNOMIAL_(X, POWER_2, 407, &peri__power_2)                                                                    \
    PERI_POLYNOMIAL_(X, POWER_3, 408, &peri__power_3)                                                                    \
    X(GAUSSIAN, 409, exp(-q * q), PERI_BY_QUADRATURE, NULL)                                                              \
    X(PROPORTIONAL, 410, q, 1.0 / (k + 2), NULL)                                                                        \
    X(INVERSE, 411, 1.0 / q, 1.0 / k, NULL)                                                                             \
    X(INVERSE_4, 412, 1.0 / (q * q * q * q), 0.0, NULL)                                                                 \
    X(POLE_EDGE, 413, q < 1.0 + edge ? 1.0 / (1.0 + edge - q) : 0.0, PERI_BY_QUADRATURE, NULL)                          \
    X(POLE_HALF, 414, peri__pole(2.0 * q - 1.0), 0.0, NULL)                                                             \
    X(POLE_QUARTER, 415, peri__in_range(exp(1.0 / (q - 0.25))), 0.0, NULL)                                              \
    X(USER, 416, peri__in_range(peri__user_influence(b, q)), PERI_BY_QUADRATURE, NULL)

#define PERI_INFLUENCE_NUMBER_(name, number, ...) PERI_SAME_NUMBER_(INFLUENCE_##name, PERI_INFLUENCE_##name == (number))
PERI_INFLUENCE_LIST(PERI_INFLUENCE_NUMBER_)
PERI_SAME_COUNT(influence, PERI_INFLUENCE_LIST, peri__count_influence);

/* A q within the horizon's tolerance is 1, so that a root there is one whatever the rounding of q. */
static double peri__within_one(double q) { return q < 1.0 - PERI_HORIZON_TOLERANCE ? q : 1.0; }

/* Squares and products of a few values beyond 1e100, or below its inverse, leave the range of double: not finite, or nothing. */
static double peri__in_range(double w) { return fabs(w) <= 1e100 ? fabs(w) >= 1e-100 ? w : 0.0 : (double)NAN; }

/* 1/|a|, and no number where a is zero up to the rounding of lengths: whether a point at the pole is refused does not hang on it. */
static double peri__pole(double a) { return fabs(a) > PERI_HORIZON_TOLERANCE ? 1.0 / fabs(a) : (double)NAN; }

static double peri__polynomial_value(const peri__polynomial *p, double q) {
    double t = peri__within_one(q), sum = 0.0;
    for (int n = p->rest - 1; n >= 0; --n) sum = sum * t + p->b[n];
    for (int n = 0; n < p->edge; ++n) sum *= 1.0 - t;
    return q <= 1.0 + PERI_HORIZON_TOLERANCE ? sum : 0.0;
}

static double peri__polynomial_moment(const peri__polynomial *p, int k) {
    double sum = 0.0;
    for (int n = 0; n < p->terms; ++n) sum += p->a[n] / (n + k + 1);
    return sum;
}

static const peri__polynomial *peri__polynomial_of(int32_t influence) {
#define PERI_POLYNOMIAL_CASE_(name, number, w, moment, polynomial)                                                     \
    case PERI_INFLUENCE_##name: return polynomial;
    switch (influence) {
        PERI_INFLUENCE_LIST(PERI_POLYNOMIAL_CASE_)
    default: return NULL;
    }
#undef PERI_POLYNOMIAL_CASE_
}

/* w(q) of the body's descriptor. edge = spacing/(2 horizon), for PERI_INFLUENCE_POLE_EDGE only. A q within the horizon's tolerance
   counts as inside. */
static double peri__influence(peri_body *b, double q, double edge) {
#define PERI_INFLUENCE_CASE_(name, number, w, moment, polynomial)                                                      \
    case PERI_INFLUENCE_##name: return w;
    switch (b->desc.influence) {
        PERI_INFLUENCE_LIST(PERI_INFLUENCE_CASE_)
    default: return 0.0;
    }
#undef PERI_INFLUENCE_CASE_
}

/* The same of count values in place, to the last bit. */
static void peri__influences(peri_body *b, double *q, int64_t count, double edge) {
    const peri__polynomial *p = peri__polynomial_of(b->desc.influence);
    for (int64_t n = 0; p && n < count; ++n) q[n] = peri__polynomial_value(p, q[n]);
    for (int64_t n = 0; !p && n < count; ++n) q[n] = peri__influence(b, q[n], edge);
}

static double peri__moment_by_panels(peri_body *b, int power, double edge, int panels) {
    double x[PERI_GAUSS], w[PERI_GAUSS], sum = 0.0;
    peri__gauss(x, w);
    for (int p = 0; p < panels; ++p)
        for (int k = 0; k < PERI_GAUSS; ++k) {
            double q = (p + x[k]) / panels;
            sum += w[k] / panels * peri__influence(b, q, edge) * pow(q, power);
        }
    return sum;
}

/* I_k, in closed form where there is one, else by Gauss-Legendre quadrature over panels, accepted only where halving the
   panels changes nothing: a function without a finite moment is refused, not guessed. Returns 0 where there is none. */
static int peri__moment(peri_body *b, int k, double edge, double *moment) {
#define PERI_MOMENT_CASE_(name, number, w, closed, polynomial)                                                         \
    case PERI_INFLUENCE_##name: *moment = closed; break;
    switch (b->desc.influence) {
        PERI_INFLUENCE_LIST(PERI_MOMENT_CASE_)
    default: return 0;
    }
#undef PERI_MOMENT_CASE_
    if (*moment >= 0.0) return *moment > 0.0;
    double coarse = peri__moment_by_panels(b, k, edge, 64);
    *moment = peri__moment_by_panels(b, k, edge, 128);
    return peri__finite(*moment) && *moment > 0.0 && fabs(*moment - coarse) <= 1e-6 * *moment;
}
