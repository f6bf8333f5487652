/* SPDX-License-Identifier: MIT */
/* fracture.c - which bonds break at an equilibrium: those over their limit, of them the most overloaded, down to `criticality` of the
   largest excess. The others may be relieved by what breaks now. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_EQUAL(b) ((b)->b32 ? 1e-4 : 1e-6) /* excesses that are no further apart are equal: both sides of a symmetric body */

#define PERI_CRITERION_ROLE_EXCESS
#include "../laws/criteria.inl"
#undef PERI_CRITERION_ROLE_EXCESS

/* By how much the criterion of bond k of row i is passed, as a ratio that goes with the load factor: stretch over its limit, or the root of
   an energy over its limit; 0 where the bond is not longer than at rest, unless shortened ones break, too. */
static double peri__excess(const peri_body *b, const peri__row *row, int64_t i, int64_t k) {
    const int64_t j = row->ids[k];
    const peri__pair *pair = peri__pair_at(b, i, j);
    const int longer = peri__elastic_stretch(b, i, row, k) > 0.0;
    double excess = 0.0;
    const double strength = peri__strength_of(b, i, row, k);
#define PERI_CASE(name, number)                                                                                        \
    if (pair->limit[(number) - peri__first_criterion] < PERI_NEVER && (longer || PERI__SHORT_##name)) {                \
        const int by_energy = ((int)PERI__SEEN_##name & (PERI__BY_WORK | PERI__BY_NODE_ENERGY)) != 0;                  \
        const double limit = pair->limit[(number) - peri__first_criterion] * (by_energy ? peri__square(strength) : strength); \
        const double passed = peri__excess_##name(b, i, row, k, limit);                                                \
        excess = fmax(excess, by_energy ? sqrt(passed) : passed);                                                      \
    }
    PERI_CRITERION_LIST(PERI_CASE)
#undef PERI_CASE
    return excess;
}

static int peri__may_break(const peri__solver *s) {
    return s->body->alive && s->body->model->breakable && s->settings->fracture;
}

/* sums->a: the largest excess, of bonds with j > i. Both directions of a bond are decided by the row of its lower id. */
static void peri__excess_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri_body *b = (const peri_body *)context;
    for (int64_t i = begin; i < end; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (row.ids[k] > i && peri__is_alive(b, i, k)) sums->a = fmax(sums->a, peri__excess(b, &row, i, k));
    }
}

static double peri__most_excess(peri_body *b) {
    const peri__model *m = b->model;
    double most = 0.0;
    peri__note_stresses(b, NULL);
    peri__for_points(b, m->points, 2 * m->width, peri__excess_block, b, b->sums);
    for (int64_t k = 0; k < m->blocks; ++k) most = fmax(most, b->sums[k].a);
    return most;
}

/* Masks, constants and row sums, where they were up to date before: only those of the `losing` points of near_dying and next to them have
   changed. Unmarks all. */
static void peri__refresh_near(peri_body *b, int64_t losing, uint32_t stale) {
    const uint32_t kept = PERI__STALE_MASKS | PERI__STALE_CONSTANTS;
    const peri__model *m = b->model;
    int64_t count = losing;
    peri__row row;
    for (int64_t n = 0; n < losing; ++n) {
        const int64_t i = b->near_dying[n];
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (peri__is_alive(b, i, k)) peri__mark(b, row.ids[k], 2, &count);
        if (stale & kept) continue;
        if (b->masks) peri__group_masks(m, i / PERI_GROUP, (uint32_t)1 << (i % PERI_GROUP), b->alive, b->masks);
        peri__set_constants(b, i, &row);
        peri__set_gather_row_sum(b, i, &row);
    }
    for (int64_t n = 0; n < count; ++n) {
        if (!(stale & kept)) peri__set_row_sum(b, b->near_dying[n]);
        b->marked[b->near_dying[n]] = 0;
    }
    if (stale & kept) return;
    peri__find_largest_row_sum(b);
    b->now.stale &= ~kept;
}

/* Of the bonds whose excess passes `limit` breaks those of `criticality` of the largest, `most`, or more; returns their number. The ledger
   is up to the caller, and that what criteria ask of points is of the present displacements. */
static int64_t peri__break_static(peri__solver *s, double most, double limit) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    const double least = s->settings->criticality * most * (1.0 - PERI_EQUAL(b));
    const uint32_t stale = b->now.stale;
    int64_t count = 0, losing = 0;
    if (b->before) memcpy(b->before, b->alive, (size_t)(m->points * m->words) * sizeof *b->alive);
    for (int64_t i = 0; i < m->points; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int64_t j = row.ids[k];
            if (j < i || !peri__is_alive(b, i, k)) continue;
            double excess = peri__excess(b, &row, i, k);
            if (!(excess > limit && excess >= least)) continue;
            peri__take_out(b, i, k, j, peri__find_bond(m, j, i));
            count++;
            if (!b->near_dying) continue;
            peri__mark(b, i, 1, &losing);
            peri__mark(b, j, 1, &losing);
        }
    }
    b->now.broken += 2 * count;
    s->report.broken += count;
    peri__changed(b, PERI__BONDS);
    if (losing > 0) peri__refresh_near(b, losing, stale);
    peri__note_breaks(b, peri__load_time(b));
    if (b->before) peri__report_breaks(b);
    return count;
}

/* Laws of bonds take an equilibrium as the latest of their history: what they lost goes to the ledger, and bonds break that they break.
   Returns the number of these; *lost: what they lost. */
static int64_t peri__keep_static(peri__solver *s, double *lost) {
    peri_body *b = s->body;
    const peri__model *m = b->model;
    peri__operands operands = peri__operands_of(b);
    *lost = 0.0;
    if (!m->law_of) return 0;
    if (b->before) memcpy(b->before, b->alive, (size_t)(m->points * m->words) * sizeof *b->alive);
    operands.keeping = s->settings->fracture ? 2 : 1;
    operands.f = s->k.q; /* b->f stays that of the equilibrium */
    operands.closing = NULL;
    peri__bond_forces(b, &operands);
    s->report.passes++;
    const peri__sums total = peri__total(b->sums, m->points);
    *lost = total.a;
    b->now.ledger.fracture += total.a;
    if (total.n == 0) return 0;
    b->now.broken += total.n;
    s->report.broken += total.n / 2;
    peri__changed(b, PERI__BONDS);
    peri__note_breaks(b, peri__load_time(b));
    if (b->before) peri__report_breaks(b);
    return total.n / 2;
}
