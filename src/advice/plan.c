/* SPDX-License-Identifier: MIT */
/* plan.c - what a scene would cost: bonds, bytes, the stable step and the time of a step, before it is made. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_PLAN (UINT64_C(0x7065726900050000) + sizeof(peri_plan_desc))
#define PERI_BYTES_PER_BOND 128     /* more than any body takes                                                           */
#define PERI_MEASURED_BONDS 400000  /* of the small body: beyond the first cache, quick to build                          */
#define PERI_MEASURED_SECONDS 0.004 /* of one measurement: long beside a tick of the clock                                */
#define PERI_MEASUREMENTS 3

PERI_API void peri_plan_desc_init(peri_plan_desc *p) {
    if (!p) return;
    memset(p, 0, sizeof *p);
    p->cookie = PERI_COOKIE_PLAN;
    p->source = PERI_SOURCE_BOX;
    p->amount = 1.0;
}

/* ---- the estimate --------------------------------------------------------------------------------------------------- */

/* The units, the points and the constants of the body to be, from its cells. */
static int32_t peri__lay_out_estimate(peri__estimate *s) {
    peri_body *b = &s->body;
    peri__model *m = &s->model;
    const peri_material_desc *material = &b->materials[0];
    const int32_t dim = b->dim;
    double volume = 1.0;
    memset(m, 0, sizeof *m);
    m->points = 1;
    for (int32_t d = 0; d < 3; ++d) {
        s->n[d] = d < dim ? s->piece.cells[d] : 1;
        s->axis[d] = d;
        m->points *= s->n[d];
        if (d < dim) volume *= s->piece.cell[d] / s->piece.cell[0];
    }
    for (int32_t d = 0; d < 2; ++d) /* the longest axis first: it alone is not walked along */
        if (s->n[s->axis[0]] < s->n[s->axis[d + 1]]) {
            const int32_t longest = s->axis[d + 1];
            s->axis[d + 1] = s->axis[0];
            s->axis[0] = longest;
        }
    m->memory = b->memory;
    m->dim = dim;
    m->blocks = (m->points + PERI_BLOCK - 1) / PERI_BLOCK;
    m->stride = peri__stride(m->points);
    m->length = s->piece.cell[0];
    m->spacing = pow(volume, 1.0 / dim);
    m->horizon = b->desc.horizon / m->length;
    m->density = material->density;
    m->stress = peri__young(material, b->desc.space);
    m->materials = 1;
    m->rho[0] = 1.0;
    m->laws[0] = peri__law_of(material, b->desc.space, m->stress);
    m->volume = s->volume;
    m->material = s->material;
    s->volume[0] = s->volume[1] = volume;
    peri__note_law(m, &m->laws[0], material->criterion);
    peri__note_inelastic(m, 0, material);
    s->corrected = b->desc.correction >= PERI_CORRECTION_MOMENT || (m->pairwise && b->desc.correction != PERI_CORRECTION_NONE);

    memset(&s->cloud, 0, sizeof s->cloud);
    s->cloud.body = b;
    s->cloud.model = m;
    s->cloud.x = s->x;
    s->cloud.largest = m->spacing;
    for (int32_t d = 0; d < dim; ++d)
        if (s->piece.cell[d] / m->length > s->cloud.largest) s->cloud.largest = s->piece.cell[d] / m->length;
    s->cloud.edge = 0.5 * m->spacing / m->horizon;
    peri__gauss(s->cloud.gauss_x, s->cloud.gauss_w);
    peri__set_reach(&s->cloud);
    peri__clear_partial_volumes(&s->parts);
    int32_t status = peri__fill_units(b, m);
    if (status == PERI_OK) status = peri__constants(b, material, m->stress, m->length, s->cloud.edge, &s->pair);
    m->breakable = peri__is_breakable(&s->pair);
    m->criteria = peri__criteria_of(&s->pair);
    return status;
}

static int32_t peri__open_estimate(peri__estimate *s, const peri_plan_desc *plan) {
    peri_body *b = &s->body;
    memset(s, 0, sizeof *s);
    peri__start_body(b, plan->body);
    PERI_NEED_CHOICE(b, source, plan->source);
    PERI_NEED_FLAG(b, plan->measure);
    PERI_NEED_NUMBER(b, plan->amount >= 0.0 && plan->amount <= 1.0, plan->amount);
    int32_t status = peri__check_material(b, plan->material, 1);
    if (status < 0) return status;
    b->materials[b->material_count++] = *plan->material;
    status = peri__lattice(b, peri__id(b, PERI_KIND_MATERIAL, 0), plan->lo, plan->hi, plan->spacing, &s->piece);
    if (status < 0) return status;
    double volume = 1.0;
    for (int32_t d = 0; d < b->dim; ++d) volume *= s->piece.cell[d];
    if (!(volume > 0.0 && peri__finite(volume))) return peri__fail(b, PERI_ERROR_RANGE, "spacing", -1, volume);
    if (plan->source == PERI_SOURCE_POINTS) s->jitter = 0.5;
    /* vertices move evenly by up to a quarter, centroids by the mean of 2^dim of them, and neighbours apart by two of these */
    if (plan->source == PERI_SOURCE_PERTURBED) s->jitter = 0.25 * plan->amount * (b->dim == 3 ? 0.5 : sqrt(0.5));
    s->piece.lattice = plan->source == PERI_SOURCE_BOX;
    b->setup.pieces = &s->piece;
    b->setup.piece_count = 1;
    b->setup.piece_capacity = 8;
    return peri__lay_out_estimate(s);
}

/* Families, or why there are none. */
static int32_t peri__estimate_families(peri__estimate *s) {
    peri_body *b = &s->body;
    peri__model *m = &s->model;
    peri__count_bonds(s);
    peri__list_vectors(s);
    const double most = (double)s->bonds > (double)m->points * (double)s->width ? (double)s->bonds : (double)m->points * (double)s->width;
    if (most * PERI_BYTES_PER_BOND > (double)INT64_MAX) return peri__fail(b, PERI_ERROR_TOO_LARGE, "horizon", -1, (double)s->bonds);
    if (s->bonds > 0) return PERI_OK;
    if (m->horizon * (1.0 + PERI_HORIZON_TOLERANCE) < m->spacing)
        return peri__fail(b, PERI_ERROR_HORIZON, "horizon", 0, m->spacing * m->length);
    return peri__fail(b, PERI_ERROR_FAMILY, "horizon", 0, b->desc.horizon);
}

/* ---- bytes -------------------------------------------------------------------------------------------------------- */

/* What peri__build_stencil takes beside what it makes. */
static int64_t peri__builder_bytes(const peri__estimate *s) {
    const int64_t points = s->model.points, groups = (points + PERI_GROUP - 1) / PERI_GROUP;
    int64_t slots = 16, room = 8;
    while (slots < 2 * groups) slots *= 2;
    while (room < s->model.stencil.kept) room *= 2;
    int64_t bytes = (int64_t)peri__scratch_bytes(1, sizeof(peri__builder)) + (int64_t)peri__scratch_bytes(slots, sizeof(int32_t));
    return bytes + (int64_t)peri__scratch_bytes(room, sizeof(peri__column));
}

/* What peri_build takes to search families: the places twice, and the cells. The order of points is the model's where that has a list. */
static int64_t peri__search_bytes(const peri__estimate *s, int listed) {
    const peri__model *m = &s->model;
    double extent[3] = { 0.0, 0.0, 0.0 };
    int64_t cells[3];
    for (int32_t d = 0; d < m->dim; ++d) extent[d] = (double)(s->n[d] - 1) * s->piece.cell[d] / m->length;
    return (int64_t)peri__scratch_bytes(m->points * m->dim, sizeof(double))
         + (int64_t)peri__scratch_bytes((m->points + PERI_NEAR_PIECE) * m->dim, sizeof(double))
         + (listed ? 0 : (int64_t)peri__block_bytes(m->points, sizeof(int32_t)))
         + (int64_t)peri__scratch_bytes(peri__divide(extent, s->cloud.reach2, m->points, cells) + 1, sizeof(int32_t));
}

static int64_t peri__model_bytes(const peri__estimate *s) {
    int64_t held[PERI__PURPOSES] = { 0 };
    peri__count_model(&s->body, &s->model, held);
    return peri__held_total(held);
}

static int64_t peri__body_bytes(const peri__estimate *s) {
    int64_t held[PERI__PURPOSES] = { 0 };
    peri__count_body(&s->body, held);
    return peri__held_total(held);
}

/* Marks the arrays of the list as there. `other`: a place that is not that of the weights. */
static void peri__mark_list(peri__estimate *s, void *there, void *other) {
    const peri_body_desc *desc = &s->body.desc;
    peri__model *m = &s->model;
    const int centroids = desc->quadrature == PERI_QUADRATURE_PARTIAL_CENTROID;
    m->bonds = s->bonds;
    m->entries = s->bonds + PERI_GROUP;
    m->order = s->width <= PERI_VECTOR_LIMIT ? (int32_t *)there : NULL;
    m->start = (int64_t *)there;
    m->ids = (int32_t *)there;
    m->weight = there;
    m->back = s->corrected && !m->pairwise ? other : there;
    m->bond = centroids || s->width > PERI_VECTOR_LIMIT ? there : NULL;
    m->centroid = centroids ? there : NULL;
    m->partial_volume = desc->quadrature != PERI_QUADRATURE_FULL ? (float *)there : NULL;
}

static void peri__mark_stencil(peri__estimate *s, void *there) {
    peri__stencil *l = &s->model.stencil;
    l->begin = l->first = (int64_t *)there;
    l->column = (peri__column *)there;
    l->table = (peri__stencil_bond *)there;
    l->ends = s->model.seen_by & PERI__BY_WORK ? (peri__stencil_ends *)there : NULL;
}

/* Marks what peri__new_state takes. */
static void peri__mark_state(peri__estimate *s, void *there) {
    peri_body *b = &s->body;
    peri__array arrays[PERI_ARRAYS];
    b->model = &s->model;
    s->model.bonds = s->bonds;
    b->u = b->v = b->f = there;
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS; ++k) {
        const int flags = arrays[k].place == offsetof(peri_body, alive)
                       || (arrays[k].place == offsetof(peri_body, masks) && s->model.stencil.columns > 0);
        if (arrays[k].wanted || (flags && s->model.breakable)) peri__set_array(b, &arrays[k], there);
    }
}

/* The bytes after peri_build, and the most until then: while families are made, or at the end. */
static void peri__plan_bytes(peri__estimate *s, const peri_plan_desc *plan, peri_plan_report *report) {
    void *there = s->x, *other = s->volume;
    peri__model *m = &s->model;
    peri__setup *setup = &s->body.setup;
    const int stencil = peri__estimate_stencil(s), listed = stencil <= 0 || s->corrected;
    const int64_t groups = (m->points + PERI_GROUP - 1) / PERI_GROUP, sums = (int64_t)peri__scratch_bytes(m->blocks, sizeof(peri__sums));
    const int64_t bare = (int64_t)peri__block_bytes(1, sizeof(peri_body));
    int64_t most, builder = stencil < 0 ? 0 : peri__builder_bytes(s);
    if (stencil == 0) builder += 2 * (int64_t)peri__block_bytes(groups, sizeof(int64_t));
    setup->point_capacity = m->points;
    setup->local = setup->volume = (double *)there;
    setup->material = (uint8_t *)there;
    if (plan->source == PERI_SOURCE_PERTURBED) {
        s->piece.vertices = (double *)there;
        s->piece.vertex_bytes = peri__vertex_count(&s->piece, m->dim) * m->dim * (int64_t)sizeof(double);
    }
    const int64_t given = peri__body_bytes(s), search = peri__search_bytes(s, listed) + sums;
    m->width = (int32_t)s->width;
    m->x = there;
    m->portion = s->body.b32 && plan->source != PERI_SOURCE_BOX ? there : NULL;
    m->count = (int32_t *)there;
    m->pieces = &s->piece;
    m->piece_count = 1;
    m->pairs = &s->pair;
    if (stencil > 0) peri__mark_stencil(s, there);
    most = peri__model_bytes(s) + (s->corrected ? 0 : builder);
    if (listed) {
        peri__mark_list(s, there, other);
        int64_t factors = s->corrected ? (int64_t)peri__scratch_bytes(m->entries, sizeof(double)) : 0;
        if (s->body.desc.correction == PERI_CORRECTION_EQUILIBRIUM) factors += peri__balance_bytes(m->points, m->entries, m->dim);
        const int64_t bytes = peri__model_bytes(s) + (s->corrected && builder > factors ? builder : factors);
        if (bytes > most) most = bytes;
    }
    if (listed && stencil > 0) {
        peri__mark_list(s, NULL, NULL);
        m->entries = 0;
    }
    most += given + search;
    peri__fit_model(&s->body, m);
    peri__mark_state(s, there);
    const int64_t made = peri__body_bytes(s) + peri__model_bytes(s);
    report->peak = made + sums > most ? made + sums : most;
    report->bytes = made - (given - bare);
    report->columns = m->stencil.columns;
    s->piece.vertices = NULL; /* what weighs bonds would look at them */
}

/* ---- the stable step ---------------------------------------------------------------------------------------------- */

/* Cuts the longest axes down until the points are so many. */
static void peri__shrink_piece(peri__estimate *s, int64_t points) {
    int64_t most = INT64_MAX, all = 0;
    for (;;) {
        int64_t longest = 1;
        all = 1;
        for (int32_t d = 0; d < s->body.dim; ++d) {
            const int64_t n = peri__min(s->piece.cells[d], most);
            all *= n;
            if (n > longest) longest = n;
        }
        if (all <= points) break;
        most = most == INT64_MAX && longest > 4 * points ? points : longest - 1;
    }
    for (int32_t d = 0; d < s->body.dim; ++d) s->piece.cells[d] = peri__min(s->piece.cells[d], most);
}

/* Lays the scene out anew, in at most `most` cells to the horizon and `points` in all. */
static int32_t peri__coarsen_estimate(peri__estimate *s, double most, int64_t points) {
    const double coarser = s->model.horizon / s->model.spacing / most;
    for (int32_t d = 0; d < s->body.dim; ++d) {
        const double extent = s->piece.cell[d] * (double)s->piece.cells[d], edge = s->body.desc.horizon / most;
        const int64_t least = peri__min(2, s->piece.cells[d]);
        const int64_t fit = coarser > 1.0 ? (extent > edge ? (int64_t)(extent / edge + 0.5) : 1) : s->piece.cells[d];
        const int64_t kept = fit > least ? fit : least;
        s->piece.cell[d] = extent / (double)kept;
        s->piece.cells[d] = kept;
    }
    peri__shrink_piece(s, points);
    int32_t status = peri__lay_out_estimate(s);
    if (status < 0) return status;
    peri__count_bonds(s);
    peri__list_vectors(s);
    return peri__weigh_estimate(s);
}

/* Will the body have an estimate? As in frequency.c. */
static int peri__plans_sharply(const peri__estimate *s) {
    int softens = s->model.pairwise;
    for (int64_t k = 0; k < s->vector_count; ++k) softens = softens && s->weight[k] >= 0.0;
    return s->body.desc.quadrature != PERI_QUADRATURE_PARTIAL_CENTROID && (softens || !s->model.breakable);
}

/* Are some families nowhere whole? */
static int peri__is_thin(const peri__estimate *s) {
    for (int32_t d = 0; d < s->body.dim; ++d)
        if (s->n[d] < 2 * s->span[d] + 2) return 1;
    return 0;
}

/* The highest frequency, squared, of a small body: as far below its bound as it is, the scene's is below row_sum. Below 0 where that cannot
   be laid out. */
static double peri__small_estimate(peri__estimate *s, double row_sum) {
    if (peri__coarsen_estimate(s, 3.0, PERI_SMALL_POINTS) < 0) return -1.0;
    const double bound = s->model.pairwise ? peri__middle_row_sum(s) : peri__corner_row_sum(s);
    return row_sum * peri__small_frequency(s) / bound;
}

/* The stable step [T]. With many bonds to a family this hardly depends on how many: coarser cells then stand for them. The frequency of
   bodies that are not pairwise is that of a small one in so far as it exceeds its bound. */
static int32_t peri__plan_step(peri__estimate *s, double *step) {
    int64_t all = 1;
    s->jitter = 0.0;
    for (int d = 0; d < 3; ++d) all *= 1 + s->span[d];
    const int coarsen = s->vector_count == 0 || (!s->model.pairwise && all > PERI_CLASS_LIMIT);
    int32_t status = coarsen ? peri__coarsen_estimate(s, s->body.dim == 3 ? 5.0 : 15.0, INT64_MAX) : peri__weigh_estimate(s);
    if (status < 0) return status;
    double row_sum = !s->model.pairwise ? peri__corner_row_sum(s) : peri__middle_row_sum(s);
    if (!(row_sum > 1e-30 && row_sum < 1e30)) return peri__fail(&s->body, PERI_ERROR_RANGE, "horizon", -1, s->body.desc.horizon);
    const double time = s->model.time;
    if (peri__plans_sharply(s)) {
        const double symbol = s->model.pairwise ? peri__symbol_frequency(s) : 0.0;
        const int thin = peri__is_thin(s), whole = s->model.points <= PERI_SMALL_POINTS;
        double sharp = s->model.pairwise && !thin ? symbol : peri__small_estimate(s, row_sum);
        if (sharp < 0.0) return s->body.error.code;
        if (s->model.pairwise && thin && !whole) sharp = sqrt(symbol * sharp); /* one is too high, the other too low */
        if (PERI_LANCZOS_SLACK * sharp < row_sum) row_sum = PERI_LANCZOS_SLACK * sharp;
    }
    *step = 2.0 / sqrt(row_sum) * time;
    return PERI_OK;
}

/* ---- the time of a step ------------------------------------------------------------------------------------------- */

static double peri__clock(void) { return (double)clock() / CLOCKS_PER_SEC; }

/* Cells of the small body: long rows that fill groups as those of the scene do, and as many of them as give some bonds. */
static void peri__small_body(const peri__estimate *s, int64_t *cells) {
    int64_t edge = 7, points = 0, grows = 1;
    while (grows && points * s->width < PERI_MEASURED_BONDS) {
        points = 1;
        grows = 0;
        ++edge;
        for (int d = 0; d < 3; ++d) {
            const int64_t n = s->n[d], most = d > 0 ? edge : (s->n[2] > 1 ? 4 : 16) * PERI_GROUP + n % PERI_GROUP;
            cells[d] = peri__min(n, most);
            points *= cells[d];
            grows |= d > 0 && n > edge;
        }
    }
}

/* Seconds per step of a built body: the least of some measurements, or a negative status. */
static double peri__measure_steps(peri_body *b) {
    peri_advance_desc run;
    double least = 0.0;
    int done = 0;
    peri_advance_desc_init(&run);
    run.steps = 1;
    while (done < PERI_MEASUREMENTS) {
        const double from = peri__clock();
        const int32_t status = peri_advance(b, &run);
        const double taken = peri__clock() - from;
        if (status < 0) return status;
        if (taken < PERI_MEASURED_SECONDS && done == 0 && run.steps < (1 << 20)) {
            run.steps *= 2;
            continue;
        }
        if (done == 0 || taken < least) least = taken;
        ++done;
    }
    return least / (double)run.steps;
}

/* Builds and advances a small body like the scene's. The time goes by the columns or the bonds. */
static int32_t peri__measure_plan(const peri__estimate *s, const peri_plan_desc *plan, peri_plan_report *report, peri_error *error) {
    int64_t cells[3];
    peri_body_desc desc = *plan->body;
    peri_body *b;
    double hi[3] = { 0.0, 0.0, 0.0 };
    peri__small_body(s, cells);
    desc.threads = 1;
    desc.parallel_for = NULL;
    desc.log = NULL;
    for (int32_t d = 0; d < s->body.dim; ++d) hi[d] = plan->lo[d] + (double)cells[d] * s->piece.cell[d];
    int64_t status = peri_body_create(&desc, &b, error);
    if (status < 0) return (int32_t)status;
    const int32_t material = peri_add_material(b, plan->material);
    status = material;
    if (status >= 0) {
        const double amount = plan->source == PERI_SOURCE_POINTS ? 1.0 : plan->amount;
        if (plan->source == PERI_SOURCE_BOX) status = peri_add_box(b, material, plan->lo, hi, plan->spacing);
        else status = peri_add_perturbed_box(b, material, plan->lo, hi, plan->spacing, amount, 1);
    }
    if (status >= 0) status = peri_build(b);
    if (status >= 0) {
        const double seconds = peri__measure_steps(b), step = peri_stable_step(b);
        const int64_t columns = b->model->stencil.columns;
        if (seconds < 0.0) status = (int64_t)seconds;
        else if (columns > 0 && report->columns > 0) report->seconds = seconds * ((double)report->columns / (double)columns);
        else report->seconds = seconds * ((double)report->entries / (double)b->model->bonds);
        if (step < report->stable_step) report->stable_step = step;
    }
    if (status < 0 && error) (void)peri_get_error(b, error);
    peri_body_destroy(b);
    return status < 0 ? (int32_t)status : PERI_OK;
}

PERI_API int32_t peri_plan(const peri_plan_desc *plan, peri_plan_report *report, peri_error *error) {
    peri__estimate s;
    (void)peri__set_error(error, PERI_OK, "", -1, 0.0);
    if (report) memset(report, 0, sizeof *report);
    if (!plan || !report) return peri__set_error(error, PERI_ERROR_ARGUMENT, plan ? "report" : "desc", -1, 0.0);
    if (plan->cookie != PERI_COOKIE_PLAN) return peri__set_error(error, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    if (!plan->body || !plan->material) return peri__set_error(error, PERI_ERROR_ARGUMENT, plan->body ? "material" : "body", -1, 0.0);
    int32_t status = peri__check_desc(plan->body, error);
    if (status < 0) return status;
    if (plan->material->cookie != PERI_COOKIE_MATERIAL) return peri__set_error(error, PERI_ERROR_DESCRIPTOR, "material", -1, 0.0);
    status = peri__open_estimate(&s, plan);
    if (status == PERI_OK) status = peri__estimate_families(&s);
    if (status == PERI_OK) {
        peri_plan_report made;
        memset(&made, 0, sizeof made);
        made.points = s.model.points;
        made.entries = s.bonds;
        made.width = s.width;
        peri__plan_bytes(&s, plan, &made);
        if ((uint64_t)made.peak > (uint64_t)SIZE_MAX / 2)
            status = peri__fail(&s.body, PERI_ERROR_TOO_LARGE, "spacing", -1, (double)made.entries);
        else
            status = peri__plan_step(&s, &made.stable_step);
        if (status == PERI_OK) *report = made;
    }
    status = peri__heed_influence(&s.body, status);
    if (status < 0) {
        if (error) *error = s.body.error;
        return status;
    }
    if (plan->measure) {
        status = peri__open_estimate(&s, plan);
        status = peri__heed_influence(&s.body, status);
        if (status < 0 && error) *error = s.body.error;
        if (status == PERI_OK) peri__count_bonds(&s);
        if (status == PERI_OK) status = peri__measure_plan(&s, plan, report, error);
        if (status < 0) memset(report, 0, sizeof *report);
    }
    return status;
}
