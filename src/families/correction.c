/* SPDX-License-Identifier: MIT */
/* correction.c - what makes good for the missing part of a family: factors on the weights of bonds, chosen once per body.

   The uniform strain eps has the energy of the solid where the fourth moment of the family is isotropic,
       sum_j w |xi|^2 n n n n V_j = m/(D(D+2)) (delta delta + ...),   n = xi/|xi|,
   because e = |xi| n.eps.n; and a bond-based point needs m, which is then sum w |xi| V, to be that of the full horizon. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_FIT_MOST 10.0 /* the factor from which on an exact fit gives way to a compromise                              */

/* Factors x_k = max(0, 1 + lambda.n^4) of row i, nearest to 1 in the mean weighted by the bonds, whose fourth moment is isotropic: where
       phi = sum a_k x_k^2/2 - lambda.I + soft |lambda|^2/2
   is least, by Newton's method; a_k: shares of the bonds in m, I: the mean of n^4 over all directions. soft > 0: a compromise, where no
   such factors exist. lambda is a symmetric tensor and all that is made of it a contraction, so that the factors turn with the family; so
   is the shift of the Hessian, which has no inverse where the bonds have few directions: it leaves lambda next to 0 along what no bond
   sees. Returns the largest factor, or HUGE_VAL where the moment was missed by more than rounding (soft = 0). */
static double peri__fit_row(const peri__fitter *f, int64_t i, double total, double soft) {
    const peri__model *m = f->cloud->model;
    double lambda[PERI_QUARTICS] = { 0.0 }, isotropic[PERI_QUARTICS], psi[PERI_QUARTICS], step[PERI_QUARTICS] = { 0.0 };
    double n[3] = { 0.0, 0.0, 0.0 }, *x = &f->factor[m->start[i]], missed = 0.0, largest = 0.0, value = HUGE_VAL, scale = 0.0, sum = 0.0;
    const int terms = peri__quartics(m->dim, n, psi);
    peri__isotropic_quartic(m->dim, isotropic);
    for (int newton = 0; newton < 60; ++newton) {
        double g[PERI_QUARTICS], hessian[PERI_QUARTICS * PERI_QUARTICS] = { 0.0 }, trial[PERI_QUARTICS], now = 0.0, seen = 0.0;
        for (int a = 0; a < terms; ++a) {
            trial[a] = lambda[a] + scale * step[a];
            g[a] = soft * trial[a] - isotropic[a];
            now += (0.5 * soft * trial[a] - isotropic[a]) * trial[a];
        }
        for (int64_t k = 0; k < m->count[i]; ++k) {
            double share = peri__stiff(f, i, k, n) / total, factor = 1.0;
            (void)peri__quartics(m->dim, n, psi);
            for (int a = 0; a < terms; ++a) factor += trial[a] * psi[a];
            if (!(factor > 0.0)) continue;
            now += 0.5 * share * factor * factor;
            seen += share;
            for (int a = 0; a < terms; ++a) {
                g[a] += share * factor * psi[a];
                for (int c = 0; c <= a; ++c) hessian[a * PERI_QUARTICS + c] += share * psi[a] * psi[c];
            }
        }
        if (now > value + 1e-13 * (1.0 + fabs(value)) && scale > 1e-9) { /* too far: half the way. Parts of phi are of order 1 */
            scale *= 0.5;
            continue;
        }
        memcpy(lambda, trial, sizeof lambda);
        value = now;
        missed = sqrt(peri__dot(g, g, terms));
        if (missed < 4e-15) break; /* rounding of sums of order 1 */
        for (int a = 0; a < terms; ++a) hessian[a * PERI_QUARTICS + a] += soft + 1e-12 * seen; /* seen: the trace, as |n^4| = 1 */
        peri__solve(terms, PERI_QUARTICS, hessian, g, step);
        for (int a = 0; a < terms; ++a) step[a] = -step[a];
        scale = 1.0;
    }
    for (int64_t k = 0; k < m->count[i]; ++k) {
        double share = peri__stiff(f, i, k, n) / total;
        (void)peri__quartics(m->dim, n, psi);
        x[k] = 1.0;
        for (int a = 0; a < terms; ++a) x[k] += lambda[a] * psi[a];
        if (!(x[k] > 0.0)) x[k] = 0.0;
        if (x[k] > largest) largest = x[k];
        sum += share * x[k];
    }
    for (int64_t k = 0; k < m->count[i]; ++k) x[k] /= sum; /* m stays */
    return soft == 0.0 && !(missed < 1e-12) ? HUGE_VAL : largest;
}

/* Is the family of i that of an earlier point of its block, moved? Then so are its factors: on a lattice most are. */
static int peri__same_family(const peri__fitter *f, int64_t i, int64_t other) {
    const peri__model *m = f->cloud->model;
    if (m->count[i] != m->count[other] || m->material[i] != m->material[other]) return 0;
    for (int64_t k = 0; k < m->count[i]; ++k) {
        double a[3], c[3], stiff = peri__stiff(f, i, k, a), apart = fabs(stiff - peri__stiff(f, other, k, c));
        for (int32_t d = 0; d < m->dim; ++d) apart += fabs(a[d] - c[d]) * stiff;
        if (!(apart <= 1e-13 * fabs(stiff))) return 0;
    }
    return 1;
}

static void peri__fit_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__fitter *f = (const peri__fitter *)context;
    const peri_body *b = f->cloud->body;
    const peri__model *m = f->cloud->model;
    int64_t fitted = -1;
    for (int64_t i = begin; i < end; ++i) {
        double n[3], total = 0.0, least = 0.0, *x = &f->factor[m->start[i]];
        int bonds = m->laws[m->material[i]].pairwise;
        for (int64_t k = 0; k < m->count[i]; ++k) {
            double stiff = peri__stiff(f, i, k, n);
            total += stiff;
            if (stiff < least) least = stiff;
            x[k] = 1.0;
        }
        if (b->desc.correction == PERI_CORRECTION_VOLUME) {
            double volume = m->volume[i] + peri__family_volume(m, i);
            for (int64_t k = 0; bonds && k < m->count[i]; ++k) {
                int64_t j = m->ids[m->start[i] + k];
                x[k] = 2.0 * f->whole / (volume + m->volume[j] + peri__family_volume(m, j));
            }
            continue;
        }
        if (!(total > 0.0)) continue; /* refused later */
        if (b->desc.correction >= PERI_CORRECTION_MOMENT && least >= 0.0) {
            if (fitted >= 0 && !m->part && peri__same_family(f, i, fitted)) {
                memcpy(x, &f->factor[m->start[fitted]], (size_t)m->count[i] * sizeof *x);
                continue;
            }
            fitted = i;
            if (!(peri__fit_row(f, i, total, 0.0) < PERI_FIT_MOST)) {
                sums->n++;
                (void)peri__fit_row(f, i, total, PERI_FIT_SOFT);
            }
        }
        for (int64_t k = 0; bonds && k < m->count[i]; ++k) x[k] *= f->full / total;
    }
}

/* Puts the factors into the weights: a bond between bond-based points has one weight, else each half has its own. */
static void peri__apply_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__fitter *f = (const peri__fitter *)context;
    const peri_body *b = f->cloud->body;
    peri__model *m = f->cloud->model;
    (void)sums;
    for (int64_t i = begin; i < end; ++i)
        for (int64_t at = m->start[i]; at < m->start[i] + m->count[i]; ++at) {
            int64_t j = m->ids[at];
            double own = f->factor[at], other = f->factor[m->start[j] + peri__find_listed(m, j, i)];
            double weight = peri__get_real(m->weight, b->b32, at);
            if (!m->pairwise) peri__put_real(m->back, b->b32, at, weight * other);
            peri__put_real(m->weight, b->b32, at, weight * (m->pairwise ? 0.5 * (own + other) : own));
        }
}

/* Does the descriptor ask for factors on the weights, and not of state-based points alone that know none? */
static int peri__corrects(const peri_body *b, const peri__model *m) {
    int bonds = 0;
    for (int64_t i = 0; i < m->points; ++i) bonds |= m->laws[m->material[i]].pairwise;
    if (m->part) bonds = m->pairwise || m->mixed; /* of all parts */
    return b->desc.correction >= PERI_CORRECTION_MOMENT || (bonds && b->desc.correction != PERI_CORRECTION_NONE);
}

/* Corrects the weights as the descriptor asks. Influence functions were checked to have moments where bond-based materials are. */
static int32_t peri__correct(peri_body *b, peri__cloud *c, peri__sums *sums) {
    peri__model *m = c->model;
    peri__fitter f;
    int64_t missed = 0;
    double h = m->horizon, moment = 0.0;
    size_t real = peri__bond_real(b);
    m->back = m->weight;
    if (!peri__corrects(b, m)) return PERI_OK;
    if (!m->pairwise) m->back = peri__new(&m->memory, m->entries, real);
    f.cloud = c;
    f.factor = (double *)peri__new(&b->scratch, m->entries, sizeof *f.factor);
    if (!f.factor || !m->back) {
        peri__delete(&b->scratch, f.factor, m->entries, sizeof *f.factor);
        return peri__fail(b, PERI_ERROR_MEMORY, "correction", -1, 0.0);
    }
    (void)peri__moment(b, m->dim, 0.5 * m->spacing / h, &moment);
    f.full = m->dim == 3 ? 4.0 * PERI_PI * h * h * h * h * moment : 2.0 * PERI_PI * h * h * h * moment;
    f.whole = m->dim == 3 ? 4.0 / 3.0 * PERI_PI * h * h * h : PERI_PI * h * h;
    peri__for_points(b, m->points, 64 * m->width, peri__fit_block, &f, sums);
    missed = peri__total(sums, m->points).n;
    if (missed > 0) peri__log(b, 0, "moment correction: some families near surfaces have no isotropic weights; the nearest are taken");
    const int32_t status = b->desc.correction == PERI_CORRECTION_EQUILIBRIUM ? peri__balance_weights_of(b, &f, sums) : PERI_OK;
    if (status == PERI_OK) peri__for_points(b, m->points, 8 * m->width, peri__apply_block, &f, sums);
    peri__delete(&b->scratch, f.factor, m->entries, sizeof *f.factor);
    return status;
}
