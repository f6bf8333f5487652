/* SPDX-License-Identifier: MIT */
/* bond_laws.c - laws of bonds that are not linear: tables that soften, and functions of the caller.

   A bond of stretch s gives the force c w phi M, phi = s of a linear one. A table has phi = s up to the stretch `first`, and falls to 0 at
   `last`, straight between its points. It is followed as a bond is stretched further than ever before; below that the bond goes
     secant    to the origin: phi = s F(k)/k,      stored phi s/2,   lost A(k) - F(k) k/2
     elastic   by its first slope: phi = s - k + F(k),   stored phi^2/2,   lost A(k) - F(k)^2/2
   with k the farthest stretch, its history, F the table and A the area below it up to there. Energies are over c w |xi|. What is lost never
   falls where F(k)/k does not rise and the slope of F is at most 1: tables that fall have both. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* The piece of the curve in which s lies: the point at its end; s > first. */
static int32_t peri__curve_piece(const peri__bond_law *law, double s) {
    int32_t k = 2;
    while (k < law->count - 1 && s > law->stretch[k]) ++k;
    return k;
}

/* F(s) of s > first, its slope, and A(s). */
static double peri__curve_at(const peri__bond_law *law, double s, double *slope, double *area) {
    const int32_t k = peri__curve_piece(law, s);
    const double s0 = law->stretch[k - 1], f0 = law->force[k - 1], f1 = law->force[k];
    if (s >= law->last) {
        *slope = 0.0;
        *area = law->area[law->count - 1];
        return 0.0;
    }
    *slope = (f1 - f0) / (law->stretch[k] - s0);
    const double f = f0 + *slope * (s - s0);
    *area = law->area[k - 1] + 0.5 * (f0 + f) * (s - s0);
    return f;
}

typedef struct peri__bond_point { /* what a table says of one bond                                                        */
    double force, tangent, energy, lost; /* lost: since it was new                                                        */
} peri__bond_point;

/* At the stretch s, the farthest so far, s included, being k. */
static peri__bond_point peri__table_at(const peri__bond_law *law, double s, double k) {
    const int elastic = law->unloading == PERI_UNLOADING_ELASTIC;
    peri__bond_point p = { s, 1.0, 0.0, 0.0 };
    double slope = 1.0, area = 0.0, most = k;
    if (k > law->first) most = peri__curve_at(law, k, &slope, &area);
    if (elastic) p.force = k > law->first ? s - k + most : s;
    else if (k > law->first && s > 0.0) p.force = s * (p.tangent = most / k);
    if (p.force < 0.0) p.force *= (p.tangent = law->compression);
    p.energy = elastic ? 0.5 * p.force * p.force / p.tangent : 0.5 * p.force * s;
    if (k > law->first) p.lost = area - 0.5 * most * (elastic ? most : k);
    return p;
}

/* The table as a law like those of callers. */
static int32_t peri__follow_table(const peri__bond_law *law, const peri_bond_row *row) {
    for (int32_t n = 0; n < row->count; ++n) {
        const double s = row->stretch[n], kept = row->state[n];
        if (s <= law->first && kept <= law->first) { /* as new */
            row->force[n] = s < 0.0 ? law->compression * s : s;
            if (row->tangent) row->tangent[n] = s < 0.0 ? law->compression : 1.0;
            if (row->energy) row->energy[n] = 0.5 * row->force[n] * s;
            continue;
        }
        const int further = s > kept && s > law->first;
        const peri__bond_point p = peri__table_at(law, s, further ? s : kept);
        double slope = p.tangent, area;
        if (s > law->first && s > kept * (1.0 + 1e-5)) (void)peri__curve_at(law, s, &slope, &area); /* the rounding of s is no growth */
        row->force[n] = p.force;
        if (row->tangent) row->tangent[n] = slope;
        if (row->energy) row->energy[n] = p.energy;
        if (!row->lost) continue;
        row->lost[n] = further ? p.lost - peri__table_at(law, s, kept).lost : 0.0;
        row->broken[n] = further && s >= law->last;
        if (further) row->state[n] = s;
    }
    return 0;
}

/* ---- the laws of the bonds of a row --------------------------------------------------------------------------------- */

/* Which law bond k of row i follows, NULL: none. Bonds that are not to fail follow no table. */
static const peri__bond_law *peri__law_of_bond(const peri__operands *o, int64_t i, int64_t j) {
    const peri__model *m = o->model;
    const int32_t at = m->law_of[m->material[i] * m->materials + m->material[j]];
    const peri__bond_law *law = at > 0 ? &o->bond_laws[at - 1] : NULL;
    const int lasting = o->point_class && (o->point_class[i] >= m->materials || o->point_class[j] >= m->materials);
    return law && !law->fn && (lasting || law->brittle) ? NULL : law;
}

static double peri__zero_if_finite(int32_t n, const double *a) {
    double sum[4] = { 0.0 };
    int32_t k = 0;
    for (; k + 4 <= n; k += 4)
        for (int l = 0; l < 4; ++l) sum[l] += a[k + l] - a[k + l];
    for (; k < n; ++k) sum[0] += a[k] - a[k];
    return sum[0] + sum[1] + sum[2] + sum[3];
}

/* What a law makes of all bonds of a bunch; 0 where it fails or writes what is not finite. */
static int peri__follow_law(const peri__operands *o, const peri__bond_law *law, int64_t i, peri__bunch *bunch) {
    const int32_t n = bunch->count, history = bunch->asked & PERI__ASK_HISTORY;
    const size_t bytes = (size_t)n * sizeof(double);
    double length[PERI_BUNCH], sum;
    peri_bond_row row = { (int32_t)i, n, bunch->others, length, bunch->stretch, bunch->state, bunch->force,
                          bunch->asked & PERI__ASK_TANGENT ? bunch->tangent : NULL, bunch->asked & PERI__ASK_ENERGY ? bunch->energy : NULL,
                          history ? bunch->lost : NULL, history ? bunch->broken : NULL };
    for (int32_t k = 0; k < n; ++k) length[k] = bunch->length[k] * o->model->length;
    memset(bunch->force, 0, bytes);
    if (row.tangent) memset(row.tangent, 0, bytes);
    if (row.energy) memset(row.energy, 0, bytes);
    if (history) memset(row.lost, 0, bytes);
    if (history) memset(row.broken, 0, (size_t)n * sizeof *row.broken);
    if (!law->fn) return peri__follow_table(law, &row) == 0;
    if (law->fn(law->user, &row) < 0) return 0;
    sum = peri__zero_if_finite(n, row.force);
    if (row.tangent) sum += peri__zero_if_finite(n, row.tangent);
    if (row.energy) sum += peri__zero_if_finite(n, row.energy);
    if (history) sum += peri__zero_if_finite(n, row.lost) + peri__zero_if_finite(n * law->states, row.state);
    return sum == 0.0;
}

/* Copies the kept state of `count` bonds, `states` numbers each, from the row's, or back. where: their places there; NULL: in turn. */
static void peri__copy_states(const peri__operands *o, int32_t states, int32_t count, const int32_t *where, double *history, double *state,
                              int back) {
    const int32_t stride = o->model->bond_states;
    for (int32_t k = 0; k < count; ++k) {
        double *kept = &history[(where ? where[k] : k) * stride], *own = &state[k * states];
        memcpy(back ? kept : own, back ? own : kept, (size_t)states * sizeof *own);
    }
}

/* Lets all bonds of a bunch follow a law, with their history at `history`, where it has one. 0 where it fails. */
static int peri__follow_kept(const peri__operands *o, const peri__bond_law *law, int64_t i, const int32_t *where, double *history,
                             peri__bunch *bunch) {
    const int keeping = o->keeping && bunch->asked & PERI__ASK_HISTORY;
    if (law->states > 0) peri__copy_states(o, law->states, bunch->count, where, history, bunch->state, 0);
    if (!peri__follow_law(o, law, i, bunch)) return 0;
    if (law->states > 0 && keeping) peri__copy_states(o, law->states, bunch->count, where, history, bunch->state, 1);
    return 1;
}

/* Of each bond of a bunch the law that it follows. Returns that of all, or sets *mixed. */
static const peri__bond_law *peri__laws_of_bunch(const peri__operands *o, int64_t i, const peri__bunch *bunch,
                                                 const peri__bond_law **laws, int *mixed) {
    const peri__bond_law *first = peri__law_of_bond(o, i, bunch->others[0]);
    *mixed = 0;
    if (o->model->materials == 1 && !o->point_class) return first;
    for (int32_t k = 0; k < bunch->count; ++k) {
        laws[k] = peri__law_of_bond(o, i, bunch->others[k]);
        *mixed |= laws[k] != first;
    }
    return first;
}

/* Bonds that follow no law are linear. */
static void peri__follow_none(peri__bunch *bunch) {
    for (int32_t k = 0; k < bunch->count; ++k) {
        bunch->force[k] = bunch->stretch[k];
        bunch->tangent[k] = 1.0;
        bunch->energy[k] = 0.5 * peri__square(bunch->stretch[k]);
        bunch->lost[k] = 0.0;
        bunch->broken[k] = 0;
    }
}

/* Lets those bonds of a bunch follow `law` that do by `laws`: it sees no others. 0 where it fails. */
static int peri__follow_apart(const peri__operands *o, const peri__bond_law *law, const peri__bond_law *const *laws, int64_t i,
                              double *history, peri__bunch *bunch) {
    int32_t where[PERI_BUNCH];
    peri__bunch part;
    part.count = 0;
    part.asked = bunch->asked;
    for (int32_t k = 0; k < bunch->count; ++k) {
        if (laws[k] != law) continue;
        part.others[part.count] = bunch->others[k];
        part.length[part.count] = bunch->length[k];
        part.stretch[part.count] = bunch->stretch[k];
        where[part.count++] = k;
    }
    if (!peri__follow_kept(o, law, i, where, history, &part)) return 0;
    for (int32_t n = 0; n < part.count; ++n) {
        const int32_t k = where[n];
        bunch->force[k] = part.force[n];
        if (part.asked & PERI__ASK_TANGENT) bunch->tangent[k] = part.tangent[n];
        if (part.asked & PERI__ASK_ENERGY) bunch->energy[k] = part.energy[n];
        if (!(part.asked & PERI__ASK_HISTORY)) continue;
        bunch->lost[k] = part.lost[n];
        bunch->broken[k] = part.broken[n];
    }
    return 1;
}

/* What their laws make of the bonds `first`, ... of row i, whose number, other ends, stretches and lengths the bunch has; and their
   history, where that is asked for and o->keeping. Returns 0 where a law failed. Both ends of a bond get the same to the last bit, as they
   give the same. */
PERI_SHARED int peri__respond(const peri__operands *o, int64_t i, int64_t first, peri__bunch *bunch) {
    const peri__bond_law *laws[PERI_BUNCH], *law;
    double *history = o->history ? o->history + (o->model->start[i] + first) * o->model->bond_states : NULL;
    int mixed, ok = 1;
    law = peri__laws_of_bunch(o, i, bunch, laws, &mixed);
    if (law && !mixed) return peri__follow_kept(o, law, i, NULL, history, bunch);
    peri__follow_none(bunch);
    for (int32_t q = 0; mixed && q < bunch->count && ok; ++q) { /* law after law */
        int seen = laws[q] == NULL;
        for (int32_t k = 0; k < q; ++k) seen |= laws[k] == laws[q];
        if (!seen) ok = peri__follow_apart(o, laws[q], laws, i, history, bunch);
    }
    return ok;
}

/* How stiff a spring is that pulls as the bond does: of bonds in compression, or that unload elastically, their tangent. */
PERI_SHARED double peri__secant(double stretch, double force, double tangent) {
    const double least = 1e-5, along = fabs(stretch) > 0.0 ? force / stretch : tangent;
    return fmax(fmin(along, fmax(tangent, 1.0)), fmax(tangent, least));
}

/* What is left of the force of a live bond at the farthest stretch that it has had, over that of a linear bond: 1 where no table is. */
static double peri__bond_left(const peri_body *b, int64_t i, const peri__row *row, int64_t k) {
    const peri__model *m = b->model;
    const int32_t at = m->law_of[m->material[i] * m->materials + m->material[row->ids[k]]];
    const peri__bond_law *law = at > 0 ? &b->bond_laws[at - 1] : NULL;
    if (!law || law->fn || law->brittle) return 1.0;
    const double farthest = b->history[(row->first + k) * m->bond_states];
    double slope, area;
    return farthest > law->first ? peri__curve_at(law, farthest, &slope, &area) / farthest : 1.0;
}

#define PERI_BOND_LAW_NUMBERS (8 + 2 * PERI_SOFTENING_POINTS)

/* What a checkpoint must find the same; returns how many numbers. */
static int peri__bond_law_numbers(const peri__bond_law *law, double *out) {
    const double head[8] = { law->i, law->j, law->states, law->unloading, law->compression, law->fn != NULL, law->brittle, law->last };
    memcpy(out, head, sizeof head);
    memcpy(out + 8, law->stretch, (size_t)law->count * sizeof *out);
    memcpy(out + 8 + law->count, law->force, (size_t)law->count * sizeof *out);
    return 8 + 2 * law->count;
}
