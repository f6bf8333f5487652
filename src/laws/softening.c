/* SPDX-License-Identifier: MIT */
/* softening.c - tables of bonds that soften, from a strength and a fracture energy, and how laws of bonds are declared.

   Both follow from sums over a family as it is in the body, of the points of most neighbours that in their middle, for a crack across and
   a pull along each axis, of which the mean is taken:
     energy     the bonds across a unit of area, each pulled apart for good, take c w |xi| A: G0 = A sum_{xi_a > 0} c w V |xi| xi_a
     strength   under uniaxial tension bonds have s = eps n_a^2 + lat (1 - n_a^2) where n = xi/|xi|, lat such that nothing pulls across.
                The stress is sum c w V |xi| phi(s) n_a^2/2: more than E times the first softening stretch at its peak, since bonds aslant
                come to theirs later.
   `first` is found such that the peak is the strength; the rest of A is what the shape is scaled by. Where even first = last = sqrt(2 A)
   gives less than the strength the bond is brittle. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_SOFTENING (UINT64_C(0x7065726900290000) + sizeof(peri_softening_desc))

PERI_API void peri_softening_desc_init(peri_softening_desc *d, int32_t shape) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_SOFTENING;
    d->shape = shape;
    d->unloading = PERI_UNLOADING_SECANT;
    d->compression = 1.0;
}

/* ---- shapes ---------------------------------------------------------------------------------------------------------- */

static int32_t peri__check_table(peri_body *b, const peri_softening_desc *d) {
    if (d->shape != PERI_SOFTENING_TABLE) {
        PERI_NEED(b, d->count == 0, "count");
        PERI_NEED(b, !d->table, "table");
        return PERI_OK;
    }
    PERI_NEED(b, d->count >= 2 && d->count <= PERI_SOFTENING_POINTS - 2, "count");
    PERI_NEED(b, d->table, "table");
    for (int64_t k = 0; k < d->count; ++k) {
        const double x = d->table[2 * k], y = d->table[2 * k + 1];
        const int ascends = k == 0 ? x == 0.0 : x > d->table[2 * k - 2];
        const int falls = k == 0 ? y == 1.0 : k == d->count - 1 ? y == 0.0 : y > 0.0 && y <= d->table[2 * k - 1];
        if (!(peri__finite(x) && ascends)) return peri__fail(b, PERI_ERROR_RANGE, "table", 2 * k, x);
        if (!falls) return peri__fail(b, PERI_ERROR_RANGE, "table", 2 * k + 1, y);
    }
    return PERI_OK;
}

/* Trilinear: of concrete the first branch, extended to 0, has 0.4 of the area (Bazant 2002: G_F = 2.5 G_f), and ends at 1/4. */
static void peri__take_shape(peri__bond_law *law, const peri_softening_desc *d) {
    static const double bilinear[2][2] = { { 0.0, 1.0 }, { 1.0, 0.0 } };
    static const double trilinear[3][2] = { { 0.0, 1.0 }, { 3.0 / 28.0, 0.25 }, { 1.0, 0.0 } };
    const int32_t most = PERI_SOFTENING_POINTS - 2;
    law->given = d->shape == PERI_SOFTENING_TABLE ? (int32_t)d->count : d->shape == PERI_SOFTENING_BILINEAR ? 2
               : d->shape == PERI_SOFTENING_TRILINEAR ? 3 : most;
    if (d->shape == PERI_SOFTENING_TABLE) memcpy(law->shape, d->table, (size_t)law->given * sizeof *law->shape);
    if (d->shape == PERI_SOFTENING_BILINEAR) memcpy(law->shape, bilinear, sizeof bilinear);
    if (d->shape == PERI_SOFTENING_TRILINEAR) memcpy(law->shape, trilinear, sizeof trilinear);
    for (int32_t k = 0; d->shape == PERI_SOFTENING_EXPONENTIAL && k < most; ++k) { /* points dense where it bends most */
        const double part = (double)k / (most - 1), x = -log(1.0 - 0.99 * part);
        law->shape[k][0] = x;
        law->shape[k][1] = k == most - 1 ? 0.0 : exp(-x);
    }
}

/* The area below the shape. */
static double peri__shape_area(const peri__bond_law *law) {
    double area = 0.0;
    for (int32_t k = 1; k < law->given; ++k)
        area += 0.5 * (law->shape[k][1] + law->shape[k - 1][1]) * (law->shape[k][0] - law->shape[k - 1][0]);
    return area;
}

/* The curve that softens from the stretch `first` on and has the given area. */
static void peri__draw_curve(peri__bond_law *law, double first, double area) {
    const double scale = fmax(area - 0.5 * first * first, 0.0) / (first * peri__shape_area(law));
    law->count = law->given + 1;
    law->first = first;
    law->stretch[0] = law->force[0] = law->area[0] = 0.0;
    for (int32_t k = 1; k < law->count; ++k) {
        law->stretch[k] = first + scale * law->shape[k - 1][0];
        law->force[k] = first * law->shape[k - 1][1];
        law->area[k] = law->area[k - 1] + 0.5 * (law->force[k] + law->force[k - 1]) * (law->stretch[k] - law->stretch[k - 1]);
    }
    law->last = law->stretch[law->count - 1];
}

/* ---- calibration ------------------------------------------------------------------------------------------------------ */

typedef struct peri__tension { /* a family pulled along one axis: of each bond c w V |xi|/2 and n_a^2                     */
    const peri__bond_law *law;
    int64_t count;
    const double *weight, *square;
    double lateral; /* found last                                                                                         */
} peri__tension;

/* The stress along the axis at the strain eps, none across. */
static double peri__tension_at(peri__tension *t, double eps) {
    double along = 0.0;
    for (int step = 0; step < 12; ++step) { /* springs as soft as bonds are by now: it only falls, and ends */
        double across = 0.0, stiff = 0.0;
        along = 0.0;
        for (int64_t k = 0; k < t->count; ++k) {
            const double square = t->square[k], s = eps * square + t->lateral * (1.0 - square);
            const double force = peri__table_at(t->law, s, s > t->law->first ? s : 0.0).force;
            along += t->weight[k] * force * square;
            across += t->weight[k] * force * (1.0 - square);
            stiff += t->weight[k] * (s != 0.0 ? force / s : 1.0) * peri__square(1.0 - square);
        }
        if (!(stiff > 0.0) || fabs(across) <= 1e-6 * fabs(along)) break;
        t->lateral -= across / stiff;
    }
    return along;
}

/* The largest stress under growing strain. */
static double peri__tension_peak(peri__tension *t) {
    double best = 0.0, at = t->law->first;
    t->lateral = -0.3 * at;
    for (double eps = t->law->first; eps < 12.0 * t->law->first; eps *= 1.02) {
        const double stress = peri__tension_at(t, eps);
        if (stress > best) at = eps;
        if (stress > best) best = stress;
        if (stress < 0.7 * best) break;
    }
    double low = fmax(at / 1.02, t->law->first), high = at * 1.02;
    for (int k = 0; k < 14; ++k) {
        const double p = low + 0.382 * (high - low), q = low + 0.618 * (high - low);
        const double a = peri__tension_at(t, p), c = peri__tension_at(t, q);
        best = fmax(best, fmax(a, c));
        if (a > c) high = q;
        else low = p;
    }
    return best;
}

typedef struct peri__reference { /* a family that laws are fitted to, along each axis                                     */
    peri__row row;
    double    weight[PERI_VECTOR_LIMIT], square[3][PERI_VECTOR_LIMIT];
    double    energy; /* mean over axes of sum_{xi_a > 0} c w V |xi| xi_a                                                 */
} peri__reference;

/* The point of material i that has the most bonds, of these the one in the middle; -1: none. */
static int64_t peri__middle_of(const peri__model *m, int32_t material) {
    double centre[3] = { 0.0 }, nearest = HUGE_VAL;
    int64_t at = -1, number = 0, most = 0;
    for (int64_t i = 0; i < m->points; ++i)
        if (m->material[i] == material) most = m->count[i] > most ? m->count[i] : most;
    for (int pass = 0; pass < 2; ++pass)
        for (int64_t i = 0; i < m->points; ++i) {
            double apart = 0.0;
            if (m->material[i] != material || m->count[i] < most) continue;
            for (int32_t d = 0; d < m->dim; ++d) {
                const double x = peri__get_real(m->x, m->f32, d * m->stride + i);
                if (pass == 0) centre[d] += x;
                else apart += peri__square(x - centre[d] / (double)number);
            }
            number += pass == 0;
            if (pass == 0 || !(apart < nearest)) continue;
            nearest = apart;
            at = i;
        }
    return at;
}

static void peri__take_reference(const peri_body *b, int64_t i, double c, peri__reference *r) {
    const peri__model *m = b->model;
    peri__read_row(b, i, &r->row);
    r->energy = 0.0;
    r->row.count = peri__min(r->row.count, PERI_VECTOR_LIMIT);
    for (int64_t k = 0; k < r->row.count; ++k) {
        const double length = peri__get_real(r->row.bond, b->b32, k);
        double xi[3];
        peri__bond_of(m, b->f32, i, r->row.ids[k], xi);
        r->weight[k] = 0.5 * c * peri__weight_of(m, i, r->row.weight, k) * length;
        for (int32_t d = 0; d < m->dim; ++d) {
            r->square[d][k] = peri__square(xi[d] / length);
            r->energy += r->weight[k] * fabs(xi[d]) / m->dim;
        }
    }
}

/* The strength of a curve that begins to soften at `first`. */
static double peri__tabled_strength(peri__bond_law *law, const peri__reference *r, int32_t dim, double first, double area) {
    double strength = 0.0;
    peri__draw_curve(law, first, area);
    for (int32_t d = 0; d < dim; ++d) {
        peri__tension t = { law, r->row.count, r->weight, r->square[d], 0.0 };
        strength += peri__tension_peak(&t) / dim;
    }
    return strength;
}

/* strength: inner units. */
static void peri__fit_table(peri__bond_law *law, const peri__reference *r, int32_t dim, double strength, double area) {
    const double most = sqrt(2.0 * area);
    double high = most, low = 0.0, above = peri__tabled_strength(law, r, dim, most, area) - strength, below = -strength;
    law->brittle = above <= 0.0;
    for (int k = 0; !law->brittle && k < 60; ++k) { /* the false position, halved where one end stays (Illinois) */
        const double first = low + (high - low) * below / (below - above);
        const double rest = peri__tabled_strength(law, r, dim, first, area) - strength;
        if (fabs(rest) < 1e-4 * strength || high - low < 1e-9 * most) break;
        if (rest > 0.0) {
            high = first;
            above = rest;
            below *= 0.5;
        } else {
            low = first;
            below = rest;
            above *= 0.5;
        }
    }
}

/* Fits tables to the families, and tells the model which bonds follow what. */
static int32_t peri__fit_bond_laws(peri_body *b) {
    peri__model *m = b->model;
    const int32_t n = m->materials;
    if (b->bond_law_count == 0) return PERI_OK;
    if (!m->pairwise) return peri__fail(b, PERI_ERROR_LAW, "peri_set_bond_law", -1, m->law);
    if (m->centroid) return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    if (m->seen_by) return peri__fail(b, PERI_ERROR_CRITERION, "criterion", -1, 0.0); /* rows of laws look at the stretch alone */
    m->law_of = (uint8_t *)peri__new(&m->memory, (int64_t)n * n, 1);
    peri__reference *reference = (peri__reference *)peri__new(&b->scratch, 1, sizeof *reference);
    for (int64_t k = 0; m->law_of && reference && k < b->bond_law_count; ++k) {
        peri__bond_law *law = &b->bond_laws[k];
        const int32_t i = law->i, j = law->j;
        const int64_t at = law->fn ? -1 : peri__middle_of(m, i);
        m->law_of[i * n + j] = m->law_of[j * n + i] = (uint8_t)(k + 1);
        m->bond_states = law->states > m->bond_states ? law->states : m->bond_states;
        m->breakable = 1;
        if (law->fn) continue;
        for (int32_t c = 0; c < peri__count_criterion; ++c)
            m->pairs[i * n + j].limit[c] = m->pairs[j * n + i].limit[c] = PERI_NEVER;
        if (at >= 0) {
            peri__take_reference(b, at, m->pairs[i * n + j].c, reference);
            peri__fit_table(law, reference, m->dim, law->strength / m->stress,
                            law->fracture_energy / (m->stress * m->length) / reference->energy);
        }
        if (law->brittle) {
            m->pairs[i * n + j].limit[PERI_CRITERION_STRETCH - peri__first_criterion] = law->last;
            m->pairs[j * n + i].limit[PERI_CRITERION_STRETCH - peri__first_criterion] = law->last;
            peri__log(b, 1, "peri_set_softening: the horizon is too large for the strength; bonds are brittle");
        }
        peri__set_stretch(&m->pairs[i * n + j]);
        peri__set_stretch(&m->pairs[j * n + i]);
    }
    const int ok = m->law_of && reference;
    peri__delete(&b->scratch, reference, 1, sizeof *reference);
    return ok ? PERI_OK : peri__fail(b, PERI_ERROR_MEMORY, "peri_set_bond_law", -1, 0.0);
}

/* ---- declared ---------------------------------------------------------------------------------------------------------- */

/* The law between two materials: the one that is there, or a new one; NULL where memory or numbers are short. */
static peri__bond_law *peri__bond_law_between(peri_body *b, int32_t i, int32_t j, int create) {
    peri__bond_law *law = peri__declared_law(b, i, j);
    if (law) return law;
    if (!create || b->bond_law_count == PERI_BOND_LAWS
        || !peri__grow(&b->memory, &b->bond_laws, &b->bond_law_capacity, b->bond_law_count + 1, sizeof *b->bond_laws))
        return NULL;
    return &b->bond_laws[b->bond_law_count++];
}

/* Declares `law` between two materials. */
static int32_t peri__declare_law(peri_body *b, const peri__bond_law *law, const char *name) {
    peri__bond_law *place;
    if (b->materials[law->i].law != b->materials[law->j].law || !peri__is_pairwise(b->materials[law->i].law))
        return peri__fail(b, PERI_ERROR_LAW, "i, j", -1, 0.0);
    place = peri__bond_law_between(b, law->i, law->j, 1);
    if (!place && b->bond_law_count == PERI_BOND_LAWS) return peri__fail(b, PERI_ERROR_TOO_LARGE, name, -1, PERI_BOND_LAWS);
    if (!place) return peri__fail(b, PERI_ERROR_MEMORY, name, -1, 0.0);
    *place = *law;
    return PERI_OK;
}

static int32_t peri__check_softening(peri_body *b, const peri_softening_desc *d) {
    PERI_NEED(b, d, "desc");
    if (d->cookie != PERI_COOKIE_SOFTENING) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_CHOICE(b, softening, d->shape);
    PERI_NEED_CHOICE(b, unloading, d->unloading);
    PERI_NEED_NUMBER(b, d->strength > 0.0, d->strength);
    PERI_NEED_NUMBER(b, d->fracture_energy > 0.0, d->fracture_energy);
    PERI_NEED_NUMBER(b, d->compression > 0.0 && d->compression <= 1.0, d->compression);
    return peri__check_table(b, d);
}

/* Would bonds be brittle in a body without end? By the critical stretch of the fracture energy, which is then all that there is; both that
   and the strength over E go with the stiffness of the weaker of the two. */
static int32_t peri__look_brittle(peri_body *b, const peri__bond_law *law, int32_t *brittle) {
    const double length = b->desc.horizon;
    *brittle = 0;
    for (int end = 0; end < 2; ++end) {
        peri_material_desc m = b->materials[end == 0 ? law->i : law->j];
        const double stress = peri__young(&m, b->desc.space);
        peri__pair pair;
        m.fracture_energy = law->fracture_energy;
        m.critical_stretch = 0.0;
        m.criterion = PERI_CRITERION_STRETCH;
        const int32_t former = peri__enter(b, PERI__IN_CALLBACK); /* influence_fn may be called */
        int32_t status = peri__constants(b, &m, stress, length, 0.0, &pair);
        peri__leave(b, former);
        status = peri__heed_influence(b, status);
        if (status < 0) return status;
        *brittle |= law->strength / stress >= pair.s0;
    }
    return PERI_OK;
}

PERI_API int32_t peri_set_softening(peri_body *b, int32_t i, int32_t j, const peri_softening_desc *d) {
    int32_t at[2] = { 0, 0 }, brittle = 0;
    peri__bond_law law;
    PERI_NEED_UNBUILT(b);
    int32_t status = peri__find_materials(b, i, j, at);
    if (status == PERI_OK) status = peri__check_softening(b, d);
    if (status < 0) return status;
    memset(&law, 0, sizeof law);
    law.i = at[0];
    law.j = at[1];
    law.states = 1;
    law.unloading = d->unloading;
    law.strength = d->strength;
    law.fracture_energy = d->fracture_energy;
    law.compression = d->compression;
    law.first = law.last = (double)NAN;
    peri__take_shape(&law, d);
    if (peri__is_pairwise(b->materials[law.i].law)) status = peri__look_brittle(b, &law, &brittle);
    if (status == PERI_OK) status = peri__declare_law(b, &law, "peri_set_softening");
    return status == PERI_OK && brittle ? PERI_BRITTLE : status;
}

PERI_API int32_t peri_get_softening(peri_body *b, int32_t i, int32_t j, double *first, double *last) {
    int32_t at[2] = { 0, 0 };
    PERI_NEED_BUILT(b);
    const int32_t status = peri__find_materials(b, i, j, at);
    if (status < 0) return status;
    const peri__bond_law *law = peri__bond_law_between(b, at[0], at[1], 0);
    if (!law || law->fn) return peri__fail(b, PERI_ERROR_LAW, "i, j", -1, 0.0);
    if (first) *first = law->first;
    if (last) *last = law->last;
    return law->brittle ? PERI_BRITTLE : PERI_OK;
}

PERI_API int32_t peri_set_bond_law(peri_body *b, int32_t i, int32_t j, int32_t states, peri_bond_law_fn fn, void *user) {
    int32_t at[2] = { 0, 0 };
    peri__bond_law law;
    PERI_NEED_UNBUILT(b);
    const int32_t status = peri__find_materials(b, i, j, at);
    if (status < 0) return status;
    PERI_NEED(b, states >= 0 && states <= PERI_BOND_STATES, "states");
    PERI_NEED(b, fn, "fn");
    memset(&law, 0, sizeof law);
    law.i = at[0];
    law.j = at[1];
    law.states = states;
    law.fn = fn;
    law.user = user;
    return peri__declare_law(b, &law, "peri_set_bond_law");
}
