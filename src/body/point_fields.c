/* SPDX-License-Identifier: MIT */
/* point_fields.c - fields of material: eigenstrain, strength, stiffness and density by point, strength by bond. A body has none of their
   arrays before one of them is set to something else than it is without: eigenstrain 0, factors 1, density of the materials. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__point_field {
    int32_t       field;   /* peri_field                                                                                */
    size_t        place;   /* of its array in the body                                                                  */
    double        least, most;
    peri__change  change;  /* what setting it changes                                                                   */
} peri__point_field;

/* Fields in the type of bonds, without a unit. Factors within a million either way leave all that they multiply within the range of
   float; eigenstrain is a stretch, of a bond that keeps some length. */
static const peri__point_field peri__point_fields[3] = {
    { PERI_FIELD_EIGENSTRAIN, offsetof(peri_body, eigenstrain), -0.9, 10.0, PERI__EIGENSTRAIN },
    { PERI_FIELD_STRENGTH, offsetof(peri_body, strength), 1e-6, 1e6, PERI__ACTION },
    { PERI_FIELD_STIFFNESS, offsetof(peri_body, stiffness), 1e-6, 1e6, PERI__STIFFNESS },
};

static double peri__absent_value(int32_t field) { return field == PERI_FIELD_EIGENSTRAIN ? 0.0 : 1.0; }

static int64_t peri__point_field_reals(const peri__model *m) { return m->stride + 2 * m->margin; }

/* What follows from the fields: the least strength of any bond, and by how much fields raise the highest frequency of pairwise bonds. */
static void peri__weigh_fields(peri_body *b) {
    const peri__model *m = b->model;
    double points = b->strength ? HUGE_VAL : 1.0, bonds = 1.0, stiff = b->stiffness ? 0.0 : 1.0, light = 1.0;
    for (int64_t i = 0; i < m->points; ++i) {
        if (b->strength) points = fmin(points, peri__field_at(b, b->strength, i, 1.0));
        if (b->stiffness) stiff = fmax(stiff, peri__stiffness_at(b, i));
        if (b->density) light = fmin(light, b->density[i] / m->rho[m->material[i]]);
    }
    for (int64_t k = 0; b->bond_strength && k < peri__bond_slots(m); ++k) bonds = fmin(bonds, (double)b->bond_strength[k]);
    b->least_strength = points * bonds;
    b->row_sum_factor = stiff / light;
}

/* A new array of a field, all as it is without; NULL where memory is short. */
static void *peri__new_point_field(const peri_body *b, double value) {
    const int64_t reals = peri__point_field_reals(b->model);
    void *made = peri__new(&b->memory, reals, peri__bond_real(b));
    for (int64_t k = 0; made && k < reals; ++k) peri__put_real(made, b->b32, k, value);
    return made;
}

/* Bonds to centroids, those with a law of their own, what is inelastic, and criteria of stress, confinement, rate and time know of no
   fields. */
static int32_t peri__check_fieldable(peri_body *b) {
    const uint32_t others = PERI__BY_STRESS | PERI__AND_MORE;
    if (b->model->centroid) return peri__fail(b, PERI_ERROR_LAW, "quadrature", -1, b->desc.quadrature);
    if ((uint32_t)b->model->seen_by & others) return peri__fail(b, PERI_ERROR_CRITERION, "criterion", -1, 0.0);
    if (b->model->inelastic) return peri__fail(b, PERI_ERROR_LAW, "law", -1, 0.0);
    return b->model->law_of ? peri__fail(b, PERI_ERROR_LAW, "peri_set_bond_law", -1, 0.0) : PERI_OK;
}

static int32_t peri__check_point_field(peri_body *b, int32_t field, const double *in, double least, double most) {
    const peri__model *m = b->model;
    const int32_t status = field == PERI_FIELD_DENSITY && !m->centroid ? PERI_OK : peri__check_fieldable(b);
    if (status < 0) return status;
    if (field == PERI_FIELD_EIGENSTRAIN && m->seen_by & PERI__BY_WORK) return peri__fail(b, PERI_ERROR_CRITERION, "field", -1, field);
    for (int64_t i = 0; i < m->points; ++i)
        if (!(in[i] >= least && in[i] <= most)) return peri__fail(b, PERI_ERROR_RANGE, "in", i, in[i]);
    return PERI_OK;
}

static int32_t peri__set_point_field(peri_body *b, const peri__point_field *f, const double *in) {
    const peri__model *m = b->model;
    const double without = peri__absent_value(f->field);
    void *array = peri__pointer_at(b, f->place);
    int64_t changed = 0;
    int32_t status = peri__check_point_field(b, f->field, in, f->least, f->most);
    if (status < 0) return status;
    while (changed < m->points && peri__field_at(b, array, changed, without) == in[changed]) changed++;
    if (changed == m->points) return PERI_OK; /* and nothing is stale                                                    */
    if (f->change != PERI__ACTION) status = peri__note_energy(b);
    if (status < 0) return status;
    if (!array) array = peri__new_point_field(b, without);
    if (!array) return peri__fail(b, PERI_ERROR_MEMORY, "in", -1, 0.0);
    peri__changed(b, f->change);
    peri__set_pointer_at(b, f->place, array);
    for (int64_t i = changed; i < m->points; ++i) peri__put_real(array, b->b32, m->margin + i, in[i]);
    peri__weigh_fields(b);
    return PERI_OK;
}

/* The density of point i in the unit of the caller, as it is read. */
static double peri__density_told(const peri_body *b, int64_t i) {
    return b->density ? b->density[i] * b->model->density : b->materials[b->model->material[i]].density;
}

/* As materials, within what the precision holds of the mass of points and its inverse. */
static int32_t peri__set_density(peri_body *b, const double *in) {
    const peri__model *m = b->model;
    const double light = b->f32 ? 1e-18 : 1e-150;
    for (int64_t i = 0; i < m->points; ++i)
        if (!(in[i] / m->density > light && in[i] / m->density < 1.0 / light)) return peri__fail(b, PERI_ERROR_RANGE, "in", i, in[i]);
    if (b->contact) return peri__fail(b, PERI_ERROR_ORDER, "peri_set_contact", -1, 0.0);
    int64_t changed = 0;
    while (changed < m->points && in[changed] == peri__density_told(b, changed)) changed++;
    if (changed == m->points) return PERI_OK; /* and nothing is stale */
    const int32_t status = peri__note_energy(b);
    if (status < 0) return status;
    double *array = b->density ? b->density : (double *)peri__new(&b->memory, m->points, sizeof *array);
    if (!array) return peri__fail(b, PERI_ERROR_MEMORY, "in", -1, 0.0);
    peri__changed(b, PERI__STIFFNESS);
    for (int64_t i = 0; i < m->points; ++i) array[i] = in[i] / m->density;
    b->density = array;
    peri__weigh_fields(b);
    return PERI_OK;
}

/* Of peri_set_field: PERI_ERROR_FIELD where it is no field of material. */
static int32_t peri__set_material_field(peri_body *b, int32_t field, const double *in) {
    PERI_NEED_WHOLE(b, "field");
    for (int k = 0; k < 3; ++k)
        if (peri__point_fields[k].field == field) return peri__set_point_field(b, &peri__point_fields[k], in);
    return peri__set_density(b, in);
}

static int peri__is_material_field(int32_t field) {
    return field == PERI_FIELD_EIGENSTRAIN || field == PERI_FIELD_STRENGTH || field == PERI_FIELD_STIFFNESS || field == PERI_FIELD_DENSITY;
}

/* ---- bonds ---------------------------------------------------------------------------------------------------------- */

static int peri__is_strength(double factor) { return factor >= 1e-6 && factor <= 1e6; }

static int peri__need_bond_strength(peri_body *b) {
    const int64_t count = peri__bond_slots(b->model);
    if (b->bond_strength) return 1;
    b->bond_strength = (float *)peri__new(&b->memory, count, sizeof *b->bond_strength);
    for (int64_t k = 0; b->bond_strength && k < count; ++k) b->bond_strength[k] = 1.0f;
    return b->bond_strength != NULL;
}

/* Of bond k of row i, from both ends. */
static void peri__put_bond_strength(peri_body *b, int64_t i, const peri__row *row, int64_t k, double factor) {
    const peri__model *m = b->model;
    const int64_t j = row->ids[k];
    peri__row other;
    peri__read_row(b, j, &other);
    b->bond_strength[peri__bond_slot(m, i, row, k)] = (float)factor;
    b->bond_strength[peri__bond_slot(m, j, &other, peri__find_bond(m, j, i))] = (float)factor;
}

PERI_API int64_t peri_set_strength_pairs(peri_body *b, int64_t count, const int32_t *pairs, const double *factors) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_WHOLE(b, "peri_set_strength_pairs");
    PERI_NEED(b, count >= 0, "count");
    PERI_NEED(b, pairs || count == 0, "pairs");
    PERI_NEED(b, factors || count == 0, "factors");
    const int32_t status = peri__check_fieldable(b);
    if (status < 0) return status;
    for (int64_t k = 0; k < count; ++k) {
        const int32_t i = pairs[2 * k], j = pairs[2 * k + 1];
        if (i < 0 || j < 0 || i >= b->model->points || j >= b->model->points)
            return peri__fail(b, PERI_ERROR_INDEX, "pairs", k, i < 0 || i >= b->model->points ? i : j);
        if (peri__find_bond(b->model, i, j) < 0) return peri__fail(b, PERI_ERROR_PAIR, "pairs", k, 0.0);
        if (!peri__is_strength(factors[k])) return peri__fail(b, PERI_ERROR_RANGE, "factors", k, factors[k]);
    }
    if (!peri__need_bond_strength(b)) return peri__fail(b, PERI_ERROR_MEMORY, "pairs", -1, 0.0);
    peri__changed(b, PERI__ACTION);
    for (int64_t k = 0; k < count; ++k) {
        peri__row row;
        peri__read_row(b, pairs[2 * k], &row);
        peri__put_bond_strength(b, pairs[2 * k], &row, peri__find_bond(b->model, pairs[2 * k], pairs[2 * k + 1]), factors[k]);
    }
    peri__weigh_fields(b);
    return count;
}

PERI_API int64_t peri_set_strength_if(peri_body *b, double factor, peri_pair_fn take, void *user) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_WHOLE(b, "peri_set_strength_if");
    PERI_NEED_NUMBER(b, peri__is_strength(factor), factor);
    PERI_NEED(b, take, "take");
    const int32_t status = peri__check_fieldable(b);
    if (status < 0) return status;
    const int64_t words = b->model->points * b->model->words;
    int64_t count = 0;
    uint32_t *chosen = (uint32_t *)peri__new(&b->scratch, words, sizeof *chosen);
    if (!chosen) return peri__fail(b, PERI_ERROR_MEMORY, "take", -1, 0.0);
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    const int32_t said = peri__choose_cuts(b, PERI_CUT_INITIAL, take, user, chosen);
    peri__leave(b, former);
    if (said < 0) count = peri__fail(b, PERI_ERROR_CALLBACK, "peri_pair_fn", -1, said);
    else if (!peri__need_bond_strength(b)) count = peri__fail(b, PERI_ERROR_MEMORY, "take", -1, 0.0);
    if (count == 0) peri__changed(b, PERI__ACTION);
    for (int64_t i = 0; count >= 0 && i < b->model->points; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            if (!(chosen[i * b->model->words + k / 32] >> (k % 32) & 1)) continue;
            peri__put_bond_strength(b, i, &row, k, factor);
            count++;
        }
    }
    if (count > 0) peri__weigh_fields(b);
    peri__delete(&b->scratch, chosen, words, sizeof *chosen);
    return count;
}
