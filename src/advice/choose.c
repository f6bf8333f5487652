/* SPDX-License-Identifier: MIT */
/* choose.c - the knobs for an accuracy or a budget, from a table that `make tradeoff` measured. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_GOAL (UINT64_C(0x7065726900060000) + sizeof(peri_choose_desc))
#define PERI_RESOLUTIONS 10
#define PERI_MARGIN 2.5      /* problems differ: what is expected over what was measured                                 */
#define PERI_POISSON_LOW 0.0 /* ratios that the table holds for                                                          */
#define PERI_POISSON_HIGH 0.45

PERI_API void peri_choose_desc_init(peri_choose_desc *g) {
    if (!g) return;
    memset(g, 0, sizeof *g);
    g->cookie = PERI_COOKIE_GOAL;
    g->preset = PERI_PRESET_NONE;
}

/* ---- the table ---------------------------------------------------------------------------------------------------- */

static const double peri__resolutions[PERI_RESOLUTIONS] = { 4, 6, 8, 12, 16, 24, 32, 48, 64, 96 };

/* Knobs, and the error that `build/bench/tradeoff --recipes` measured with them, in per cent, at each resolution; 0 where it was not
   measured. Each entry is the largest at this resolution or a finer one, over the problems of its kind and, of state-based laws, over the
   Poisson ratios 0.1, 0.3 and 0.45. Of stress and fracture there are measurements in the plane alone: they stand for 3D, too. */
typedef struct peri__recipe {
    const char *text;
    int32_t     law, correction, influence, precision;
    double      ratio;         /* horizon over spacing                                                                    */
    double      stabilization;
    double      nanoseconds;   /* of a bond and a step, mean of 2D and 3D, measured on one machine: only their ratios count */
    float       plane[peri__count_quantity][PERI_RESOLUTIONS]; /* by peri_quantity less the first                         */
    float       solid[2][PERI_RESOLUTIONS];                 /* deformation, waves                                         */
} peri__recipe;

static const peri__recipe peri__recipes[] = {
    { "bond-based, single precision, horizon of 3 spacings",
      PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_SINGLE, 3, 0.0, 0.6,
      { { 64.0f, 46.0f, 0, 0, 0, 0, 0, 0, 0, 0 },
        { 8.3f, 5.7f, 5.7f, 3.2f, 3.0f, 2.1f, 2.0f, 1.6f, 0, 0 },
        { 0, 17.0f, 9.3f, 3.0f, 2.3f, 2.3f, 2.3f, 2.3f, 0, 0 },
        { 0, 0, 8.2f, 4.9f, 4.9f, 4.9f, 0, 0, 0, 0 } },
      { { 75.0f, 47.0f, 37.0f, 26.0f, 21.0f, 15.0f, 12.0f, 0, 0, 0 },
        { 35.0f, 17.0f, 8.6f, 2.3f, 2.1f, 2.1f, 2.1f, 0, 0, 0 } } },
    { "bond-based, horizon of 3 spacings",
      PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_DOUBLE, 3, 0.0, 1.1,
      { { 64.0f, 46.0f, 36.0f, 24.0f, 19.0f, 12.0f, 9.3f, 6.1f, 4.9f, 4.9f },
        { 8.3f, 5.6f, 5.6f, 3.2f, 3.0f, 2.1f, 2.0f, 1.6f, 0, 0 },
        { 0, 17.0f, 9.3f, 3.0f, 2.3f, 2.3f, 2.3f, 2.3f, 0, 0 },
        { 0, 0, 8.2f, 5.0f, 5.0f, 5.0f, 5.0f, 0, 0, 0 } },
      { { 75.0f, 47.0f, 37.0f, 26.0f, 21.0f, 15.0f, 12.0f, 0, 0, 0 },
        { 35.0f, 17.0f, 8.6f, 2.3f, 2.1f, 2.1f, 2.1f, 0, 0, 0 } } },
    { "bond-based, moment correction, linear influence, horizon of 2 spacings",
      PERI_LAW_BOND_BASED, PERI_CORRECTION_MOMENT, PERI_INFLUENCE_LINEAR, PERI_PRECISION_DOUBLE, 2, 0.0, 1.5,
      { { 18.0f, 7.9f, 4.5f, 2.0f, 1.1f, 0.51f, 0.29f, 0.13f, 0.071f, 0.03f },
        { 7.0f, 2.9f, 2.9f, 1.2f, 1.1f, 0.61f, 0.51f, 0.24f, 0.22f, 0 },
        { 9.7f, 4.3f, 2.4f, 1.0f, 0.58f, 0.26f, 0.14f, 0.064f, 0.036f, 0 },
        { 0, 0, 1.2f, 1.1f, 0.98f, 0.92f, 0.89f, 0.84f, 0, 0 } },
      { { 20.0f, 9.0f, 5.1f, 2.3f, 1.3f, 0.58f, 0.33f, 0.15f, 0.083f, 0 },
        { 11.0f, 4.9f, 2.7f, 1.2f, 0.67f, 0.3f, 0.17f, 0.074f, 0, 0 } } },
    { "LPS, moment correction, linear influence, horizon of 2 spacings",
      PERI_LAW_LPS, PERI_CORRECTION_MOMENT, PERI_INFLUENCE_LINEAR, PERI_PRECISION_DOUBLE, 2, 0.0, 6.2,
      { { 18.0f, 8.0f, 4.5f, 2.0f, 1.2f, 0.52f, 0.29f, 0.13f, 0.072f, 0.03f },
        { 6.0f, 2.9f, 2.9f, 1.2f, 1.1f, 0.61f, 0.51f, 0.25f, 0.22f, 0 },
        { 0, 15.0f, 8.9f, 4.1f, 2.3f, 1.0f, 0.58f, 0.26f, 0, 0 },
        { 0, 0, 4.9f, 3.7f, 2.9f, 2.1f, 0, 0, 0, 0 } },
      { { 17.0f, 7.8f, 4.4f, 2.0f, 1.1f, 0.5f, 0.28f, 0, 0, 0 },
        { 34.0f, 16.0f, 9.5f, 4.3f, 2.5f, 1.1f, 0.62f, 0, 0, 0 } } },
    { "correspondence, single precision, horizon of 2 spacings",
      PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_SINGLE, 2, 0.2, 3.5,
      { { 7.7f, 1.7f, 0.46f, 0, 0, 0, 0, 0, 0, 0 },
        { 9.0f, 4.7f, 4.2f, 1.5f, 1.3f, 0.66f, 0.56f, 0.26f, 0, 0 },
        { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
        { 0, 0, 1.6f, 1.6f, 1.6f, 1.6f, 1.6f, 0, 0, 0 } },
      { { 24.0f, 12.0f, 7.1f, 3.3f, 0, 0, 0, 0, 0, 0 },
        { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 } } },
    { "correspondence, horizon of 2 spacings",
      PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, PERI_INFLUENCE_CONSTANT, PERI_PRECISION_DOUBLE, 2, 0.2, 4.5,
      { { 7.7f, 1.7f, 0.46f, 0.32f, 0.24f, 0.14f, 0.083f, 0.039f, 0.022f, 0.0085f },
        { 9.0f, 4.7f, 4.2f, 1.5f, 1.3f, 0.66f, 0.55f, 0.25f, 0, 0 },
        { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
        { 0, 0, 1.2f, 1.0f, 0.96f, 0.9f, 0.87f, 0, 0, 0 } },
      { { 24.0f, 12.0f, 7.1f, 3.3f, 1.9f, 0, 0, 0, 0, 0 },
        { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 } } },
    { "correspondence, influence (1 - q)^3, horizon of 2 spacings",
      PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_NONE, PERI_INFLUENCE_POWER_3, PERI_PRECISION_DOUBLE, 2, 0.2, 4.5,
      { { 12.0f, 6.2f, 3.7f, 1.7f, 1.0f, 0.46f, 0.26f, 0.12f, 0.065f, 0.027f },
        { 6.0f, 3.0f, 3.0f, 1.2f, 1.2f, 0.64f, 0.53f, 0.26f, 0, 0 },
        { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
        { 0, 0, 1.0f, 0.91f, 0.86f, 0.84f, 0.83f, 0, 0, 0 } },
      { { 14.0f, 6.7f, 3.9f, 1.8f, 1.0f, 0, 0, 0, 0, 0 },
        { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 } } },
};
#define PERI_RECIPES ((int)(sizeof peri__recipes / sizeof *peri__recipes))

static double peri__preset_error(int32_t preset, int32_t quantity) {
    static const double error[peri__end_preset - PERI_PRESET_GAME][peri__count_quantity] = {
        { 0.20, 0.20, 0.20, 0.20 }, { 0.10, 0.10, 0.10, 0.10 }, { 0.05, 0.05, 0.05, 0.05 }, { 0.01, 0.02, 0.03, 0.03 }
    };
    return error[preset - PERI_PRESET_GAME][quantity - peri__first_quantity];
}

/* ---- one recipe --------------------------------------------------------------------------------------------------- */

static const float *peri__errors_of(const peri__recipe *r, int32_t space, int32_t quantity) {
    if (space == PERI_SPACE_SOLID && quantity == PERI_QUANTITY_DEFORMATION) return r->solid[0];
    if (space == PERI_SPACE_SOLID && quantity == PERI_QUANTITY_WAVES) return r->solid[1];
    return r->plane[quantity - peri__first_quantity];
}

/* Expected error with so many spacings across the feature, by powers between what was measured; HUGE_VAL beyond it. */
static double peri__expected_error(const float *per_cent, double across) {
    int k = 0;
    while (k < PERI_RESOLUTIONS - 1 && (per_cent[k] <= 0.0f || across > peri__resolutions[k + 1])) ++k;
    if (per_cent[k] <= 0.0f || across < peri__resolutions[k]) return HUGE_VAL;
    if (across == peri__resolutions[k]) return 0.01 * PERI_MARGIN * (double)per_cent[k];
    if (k == PERI_RESOLUTIONS - 1 || per_cent[k + 1] <= 0.0f) return HUGE_VAL;
    const double part = log(across / peri__resolutions[k]) / log(peri__resolutions[k + 1] / peri__resolutions[k]);
    return 0.01 * PERI_MARGIN * exp((1.0 - part) * log((double)per_cent[k]) + part * log((double)per_cent[k + 1]));
}

typedef struct peri__candidate {
    const peri__recipe *recipe;
    const float        *per_cent;
    peri_body_desc      body;
    peri_material_desc  material;
    peri_plan_desc      plan;
    peri_plan_report    report;
    double              across, error, cost;
} peri__candidate;

/* The scene at a resolution: bonds, bytes, stable step. */
static int32_t peri__plan_candidate(peri__candidate *c, const peri_choose_desc *goal, double across, int32_t measure, peri_error *error) {
    const double spacing = goal->feature / across;
    c->across = across;
    c->error = peri__expected_error(c->per_cent, across);
    c->body.horizon = c->recipe->ratio * spacing;
    c->plan.body = &c->body;
    c->plan.material = &c->material;
    c->plan.spacing = spacing;
    c->plan.measure = measure;
    return peri_plan(&c->plan, &c->report, error);
}

static void peri__open_candidate(peri__candidate *c, const peri__recipe *r, const peri_choose_desc *goal, const peri_body_desc *body,
                                 const peri_material_desc *material) {
    memset(c, 0, sizeof *c);
    c->recipe = r;
    c->per_cent = peri__errors_of(r, body->space, goal->quantity);
    c->body = *body;
    c->body.precision = r->precision;
    c->body.influence = r->influence;
    c->body.quadrature = PERI_QUADRATURE_FULL;
    c->body.correction = r->correction;
    c->material = *material;
    c->material.law = r->law;
    c->material.poisson = peri__is_pairwise(r->law) ? (double)NAN : peri__poisson(material, body->space);
    c->material.stabilization = r->stabilization;
    peri_plan_desc_init(&c->plan);
    memcpy(c->plan.lo, goal->lo, sizeof goal->lo);
    memcpy(c->plan.hi, goal->hi, sizeof goal->hi);
}

/* The coarsest resolution, in whole spacings, that is right enough; 0 where none is. */
static double peri__needed_resolution(const float *per_cent, double error) {
    for (double across = peri__resolutions[0]; across <= peri__resolutions[PERI_RESOLUTIONS - 1]; ++across)
        if (peri__expected_error(per_cent, across) <= error) return across;
    return 0.0;
}

/* The finest resolution within the budget; 0 where none is. */
static double peri__allowed_resolution(peri__candidate *c, const peri_choose_desc *goal, peri_error *error) {
    double low = 0.0, high = 0.0, rate = 0.0;
    for (int k = 0; k < PERI_RESOLUTIONS; ++k)
        if (c->per_cent[k] > 0.0f) {
            if (low <= 0.0) low = peri__resolutions[k];
            high = peri__resolutions[k];
        }
    if (low <= 0.0) return 0.0;
    if (goal->seconds > 0.0) {
        if (peri__plan_candidate(c, goal, low, 1, error) < 0) return 0.0;
        rate = c->report.seconds / (double)c->report.entries;
    }
    int64_t fits = (int64_t)low - 1, fails = (int64_t)high + 1;
    while (fails - fits > 1) {
        const int64_t middle = fits + (fails - fits) / 2;
        const int32_t status = peri__plan_candidate(c, goal, (double)middle, 0, error);
        const int fit = status == PERI_OK && (goal->seconds <= 0.0 || rate * (double)c->report.entries <= goal->seconds) &&
                        (goal->bytes <= 0 || c->report.peak <= goal->bytes);
        if (fit) fits = middle;
        else fails = middle;
    }
    return fits < (int64_t)low ? 0.0 : (double)fits;
}

/* ---- the choice --------------------------------------------------------------------------------------------------- */

static int peri__recipe_serves(const peri__recipe *r, const peri_body_desc *body, const peri_material_desc *material) {
    if (peri__without_precision(r->precision)) return 0;
    if (!peri__is_pairwise(r->law)) return 1;
    return fabs(peri__poisson(material, body->space) - peri__bond_poisson(body->space)) <= 1e-9 &&
           material->criterion == PERI_CRITERION_STRETCH;
}

/* What is wrong with the question, if anything is. */
static int32_t peri__check_goal(const peri_choose_desc *g, const peri_body_desc *body, const peri_material_desc *material,
                                peri_error *error) {
    if (g->cookie != PERI_COOKIE_GOAL) return peri__set_error(error, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    if (material->cookie != PERI_COOKIE_MATERIAL) return peri__set_error(error, PERI_ERROR_DESCRIPTOR, "material", -1, 0.0);
    if (!PERI_IS_ONE_OF(preset, g->preset)) return peri__set_error(error, PERI_ERROR_CHOICE, "preset", -1, g->preset);
    if (!PERI_IS_ONE_OF(quantity, g->quantity))
        return peri__set_error(error, PERI_ERROR_CHOICE, "quantity", -1, g->quantity);
    if (!(g->error >= 0.0 && g->error < 1.0)) return peri__set_error(error, PERI_ERROR_RANGE, "error", -1, g->error);
    if (!(g->seconds >= 0.0 && peri__finite(g->seconds))) return peri__set_error(error, PERI_ERROR_RANGE, "seconds", -1, g->seconds);
    if (g->bytes < 0) return peri__set_error(error, PERI_ERROR_RANGE, "bytes", -1, (double)g->bytes);
    if (!(g->feature > 0.0 && peri__finite(g->feature))) return peri__set_error(error, PERI_ERROR_RANGE, "feature", -1, g->feature);
    if ((g->preset != PERI_PRESET_NONE) + (g->error > 0.0) > 1) return peri__set_error(error, PERI_ERROR_ARGUMENT, "preset", -1, 0.0);
    if (g->preset == PERI_PRESET_NONE && g->error <= 0.0 && g->seconds <= 0.0 && g->bytes == 0)
        return peri__set_error(error, PERI_ERROR_ARGUMENT, "preset", -1, 0.0);
    const double nu = peri__poisson(material, body->space);
    if (!(nu >= PERI_POISSON_LOW && nu <= PERI_POISSON_HIGH)) return peri__set_error(error, PERI_ERROR_RANGE, "poisson", -1, nu);
    return PERI_OK;
}

/* The best of all recipes: by cost where an error is given, else by error. Where none will do: *best is 0, *value the least error that
   there is. */
static int32_t peri__try_recipes(const peri_choose_desc *goal, double target, const peri_body_desc *body,
                                 const peri_material_desc *material, peri__candidate *best, double *value, peri_error *error) {
    memset(best, 0, sizeof *best);
    *value = HUGE_VAL;
    for (int k = 0; k < PERI_RECIPES; ++k) {
        peri__candidate c;
        if (!peri__recipe_serves(&peri__recipes[k], body, material)) continue;
        peri__open_candidate(&c, &peri__recipes[k], goal, body, material);
        for (int n = 0; n < PERI_RESOLUTIONS; ++n) {
            const double expected = peri__expected_error(c.per_cent, peri__resolutions[n]);
            if (expected < *value) *value = expected;
        }
        const double across = target > 0.0 ? peri__needed_resolution(c.per_cent, target) : peri__allowed_resolution(&c, goal, error);
        if (across <= 0.0) {
            if (error && error->code == PERI_ERROR_MEMORY) return PERI_ERROR_MEMORY;
            continue;
        }
        const int32_t status = peri__plan_candidate(&c, goal, across, 0, error);
        if (status < 0) return status;
        c.cost = (double)c.report.entries * c.recipe->nanoseconds / c.report.stable_step;
        if (!best->recipe || (target > 0.0 ? c.cost < best->cost : c.error < best->error)) *best = c;
    }
    return PERI_OK;
}

PERI_API int32_t peri_choose(const peri_choose_desc *goal, peri_body_desc *body, peri_material_desc *material,
                             peri_choose_report *choice, peri_error *error) {
    peri__candidate best;
    peri_error local;
    peri_body_desc desc;
    double value;
    if (!error) error = &local;
    (void)peri__set_error(error, PERI_OK, "", -1, 0.0);
    if (!goal || !body || !material || !choice)
        return peri__set_error(error, PERI_ERROR_ARGUMENT, !goal ? "desc" : !body ? "body" : !material ? "material" : "report", -1, 0.0);
    desc = *body;
    desc.horizon = 1.0; /* what is chosen need not have been set */
    desc.influence = PERI_INFLUENCE_CONSTANT;
    desc.quadrature = PERI_QUADRATURE_FULL;
    desc.correction = PERI_CORRECTION_NONE;
    desc.precision = !peri__without_precision(PERI_PRECISION_DOUBLE) ? PERI_PRECISION_DOUBLE
                   : !peri__without_precision(PERI_PRECISION_SINGLE) ? PERI_PRECISION_SINGLE
                                                                     : PERI_PRECISION_MIXED;
    int32_t status = peri__check_desc(&desc, error);
    if (status == PERI_OK) status = peri__check_goal(goal, &desc, material, error);
    if (status < 0) return status;
    const double target = goal->preset != PERI_PRESET_NONE ? peri__preset_error(goal->preset, goal->quantity) : goal->error;
    status = peri__try_recipes(goal, target, &desc, material, &best, &value, error);
    if (status < 0) return status;
    if (!best.recipe) { /* out of reach of the table, or of the budget */
        const char *field = target > 0.0 ? "error" : goal->seconds > 0.0 ? "seconds" : "bytes";
        return peri__set_error(error, PERI_ERROR_RANGE, field, -1, target > 0.0 ? value : 0.0);
    }
    status = peri__plan_candidate(&best, goal, best.across, goal->seconds > 0.0, error);
    if (status < 0) return status;
    if (goal->bytes > 0 && best.report.peak > goal->bytes)
        return peri__set_error(error, PERI_ERROR_RANGE, "bytes", -1, (double)best.report.peak);
    if (target > 0.0 && goal->seconds > 0.0 && best.report.seconds > goal->seconds)
        return peri__set_error(error, PERI_ERROR_RANGE, "seconds", -1, best.report.seconds);
    (void)peri__set_error(error, PERI_OK, "", -1, 0.0);
    *body = best.body;
    *material = best.material;
    choice->spacing = best.plan.spacing;
    choice->across = best.across;
    choice->error = best.error;
    choice->text = best.recipe->text;
    choice->cost = best.report;
    return PERI_OK;
}
