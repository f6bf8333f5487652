/* influence.c - influence functions w(q), q = |xi|/horizon, and their moments I_k = integral of w(q) q^k over [0, 1]. */
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

static const peri__polynomial peri__polynomials[] = {
    /* CONSTANT */ { 1, { 1 }, 0, 1, { 1 } },
    /* CUTOFF   */ { 1, { 1 }, 0, 1, { 1 } },
    /* LINEAR   */ { 2, { 1, -1 }, 1, 1, { 1 } },
    /* CUBIC    */ { 4, { 1, 0, -3, 2 }, 2, 2, { 1, 2 } },
    /* QUINTIC  */ { 6, { 1, 0, 0, -10, 15, -6 }, 3, 3, { 1, 3, 6 } },
    /* SEPTIC   */ { 8, { 1, 0, 0, 0, -35, 84, -70, 20 }, 4, 4, { 1, 4, 10, 20 } },
    /* POWER_2  */ { 3, { 1, -2, 1 }, 2, 1, { 1 } },
    /* POWER_3  */ { 4, { 1, -3, 3, -1 }, 3, 1, { 1 } },
};

static const peri__polynomial *peri__polynomial_of(int32_t influence) {
    int32_t count = (int32_t)(sizeof peri__polynomials / sizeof peri__polynomials[0]);
    return influence >= 1 && influence <= count ? &peri__polynomials[influence - 1] : NULL;
}

/* A q within the horizon's tolerance is 1, so that a root there is one whatever the rounding of q. */
static double peri__within_one(double q) { return q < 1.0 - PERI_HORIZON_TOLERANCE ? q : 1.0; }

/* Squares and products of a few values beyond 1e100, or below its inverse, leave the range of double: not finite, or nothing. */
static double peri__in_range(double w) { return fabs(w) <= 1e100 ? fabs(w) >= 1e-100 ? w : 0.0 : (double)NAN; }

/* w(q) of the descriptor. edge = spacing/(2 horizon), for PERI_INFLUENCE_POLE_EDGE only. A q within the horizon's tolerance
   counts as inside. */
static double peri__influence(const peri_body_desc *desc, double q, double edge) {
    int inside = q <= 1.0 + PERI_HORIZON_TOLERANCE;
    const peri__polynomial *p = peri__polynomial_of(desc->influence);
    if (desc->influence == PERI_INFLUENCE_CONSTANT) return 1.0;
    if (p) {
        double t = peri__within_one(q), sum = 0.0;
        if (!inside) return 0.0;
        for (int n = p->rest - 1; n >= 0; --n) sum = sum * t + p->b[n];
        for (int n = 0; n < p->edge; ++n) sum *= 1.0 - t;
        return sum;
    }
    switch (desc->influence) {
    case PERI_INFLUENCE_GAUSSIAN: return exp(-q * q);
    case PERI_INFLUENCE_PROPORTIONAL: return q;
    case PERI_INFLUENCE_INVERSE: return 1.0 / q;
    case PERI_INFLUENCE_INVERSE_4: return 1.0 / (q * q * q * q);
    case PERI_INFLUENCE_POLE_EDGE: return q < 1.0 + edge ? 1.0 / (1.0 + edge - q) : 0.0;
    case PERI_INFLUENCE_POLE_HALF: return 1.0 / (2.0 * q - 1.0);
    case PERI_INFLUENCE_POLE_QUARTER: return peri__in_range(exp(1.0 / (q - 0.25)));
    default: return peri__in_range(desc->influence_fn(desc->influence_user, q));
    }
}

/* The same of count values in place, to the last bit. */
static void peri__influences(const peri_body_desc *desc, double *q, int64_t count, double edge) {
    const peri__polynomial *p = peri__polynomial_of(desc->influence);
    if (!p || desc->influence == PERI_INFLUENCE_CONSTANT) {
        for (int64_t k = 0; k < count; ++k) q[k] = peri__influence(desc, q[k], edge);
        return;
    }
    for (int64_t k = 0; k < count; ++k) {
        const double t = peri__within_one(q[k]);
        double sum = 0.0;
        for (int n = p->rest - 1; n >= 0; --n) sum = sum * t + p->b[n];
        for (int n = 0; n < p->edge; ++n) sum *= 1.0 - t;
        q[k] = q[k] <= 1.0 + PERI_HORIZON_TOLERANCE ? sum : 0.0;
    }
}

static double peri__moment_by_panels(const peri_body_desc *desc, int power, double edge, int panels) {
    double x[PERI_GAUSS], w[PERI_GAUSS], sum = 0.0;
    peri__gauss(x, w);
    for (int p = 0; p < panels; ++p)
        for (int k = 0; k < PERI_GAUSS; ++k) {
            double q = (p + x[k]) / panels;
            sum += w[k] / panels * peri__influence(desc, q, edge) * pow(q, power);
        }
    return sum;
}

/* I_power, in closed form where there is one, else by Gauss-Legendre quadrature over panels, accepted only where halving the
   panels changes nothing: a function without a finite moment is refused, not guessed. Returns 0 where there is none. */
static int peri__moment(const peri_body_desc *desc, int power, double edge, double *moment) {
    const peri__polynomial *p = peri__polynomial_of(desc->influence);
    if (p) {
        double sum = 0.0;
        for (int n = 0; n < p->terms; ++n) sum += p->a[n] / (n + power + 1);
        *moment = sum;
        return 1;
    }
    switch (desc->influence) {
    case PERI_INFLUENCE_INVERSE_4:
    case PERI_INFLUENCE_POLE_HALF:
    case PERI_INFLUENCE_POLE_QUARTER: return 0;
    case PERI_INFLUENCE_PROPORTIONAL: *moment = 1.0 / (power + 2); return 1;
    case PERI_INFLUENCE_INVERSE: *moment = 1.0 / power; return 1;
    default: break;
    }
    double coarse = peri__moment_by_panels(desc, power, edge, 64);
    *moment = peri__moment_by_panels(desc, power, edge, 128);
    return peri__finite(*moment) && *moment > 0.0 && fabs(*moment - coarse) <= 1e-6 * *moment;
}
