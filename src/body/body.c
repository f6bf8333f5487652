/* SPDX-License-Identifier: MIT */
/* body.c - create, build, destroy. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_BODY (UINT64_C(0x7065726900020000) + sizeof(peri_body_desc))

PERI_API void peri_body_desc_init(peri_body_desc *d) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_BODY;
    d->precision = PERI_PRECISION_DOUBLE;
    d->geometry = PERI_GEOMETRY_NONLINEAR;
    d->influence = PERI_INFLUENCE_CONSTANT;
    d->quadrature = PERI_QUADRATURE_FULL;
    d->break_timing = PERI_BREAK_WITHIN_STEP;
    d->correction = PERI_CORRECTION_NONE;
    d->moments = PERI_MOMENTS_LIVE;
    d->kernel = PERI_KERNEL_BEST;
    d->instructions = PERI_INSTRUCTIONS_BEST;
    d->ledger = 1;
    d->thickness = 1.0;
}

/* Refuses the first choice of a descriptor that is none, or that others exclude. */
static int32_t peri__check_choices(const peri_body_desc *d, peri_error *error) {
#define PERI_CHOICE_(field, condition)                                                                                 \
    if (!(condition)) return peri__set_error(error, PERI_ERROR_CHOICE, #field, -1, (double)d->field)
    PERI_CHOICE_(space, PERI_IS_ONE_OF(space, d->space));
    PERI_CHOICE_(precision, PERI_IS_ONE_OF(precision, d->precision));
    PERI_CHOICE_(geometry, PERI_IS_ONE_OF(geometry, d->geometry));
    PERI_CHOICE_(influence, PERI_IS_ONE_OF(influence, d->influence));
    PERI_CHOICE_(quadrature, PERI_IS_ONE_OF(quadrature, d->quadrature));
    PERI_CHOICE_(quadrature, d->space != PERI_SPACE_SOLID || !peri__is_planar(d->quadrature));
    PERI_CHOICE_(correction, PERI_IS_ONE_OF(correction, d->correction));
    PERI_CHOICE_(correction, d->correction == PERI_CORRECTION_NONE || !peri__is_planar(d->quadrature));
    PERI_CHOICE_(break_timing, PERI_IS_ONE_OF(break_timing, d->break_timing));
    PERI_CHOICE_(moments, PERI_IS_ONE_OF(moments, d->moments));
    PERI_CHOICE_(kernel, PERI_IS_ONE_OF(kernel, d->kernel));
    PERI_CHOICE_(instructions, PERI_IS_ONE_OF(instructions, d->instructions));
    PERI_CHOICE_(ledger, d->ledger == 0 || d->ledger == 1);
#undef PERI_CHOICE_
    if (d->influence == PERI_INFLUENCE_USER && !d->influence_fn)
        return peri__set_error(error, PERI_ERROR_ARGUMENT, "influence_fn", -1, 0.0);
    if ((d->allocate == NULL) != (d->release == NULL))
        return peri__set_error(error, PERI_ERROR_ARGUMENT, d->allocate ? "release" : "allocate", -1, 0.0);
    if (d->threads < 0) return peri__set_error(error, PERI_ERROR_RANGE, "threads", -1, d->threads);
    if (d->number < 0 || d->number > 127) return peri__set_error(error, PERI_ERROR_RANGE, "number", -1, d->number);
    return PERI_OK;
}

/* The switch that left a space or a precision out of this build, or NULL. */
static const char *peri__without_space(int32_t space) {
#ifdef PERI_NO_2D
    if (space != PERI_SPACE_SOLID) return "PERI_NO_2D";
#endif
#ifdef PERI_NO_3D
    if (space == PERI_SPACE_SOLID) return "PERI_NO_3D";
#endif
    (void)space;
    return NULL;
}

static const char *peri__without_precision(int32_t precision) {
#ifdef PERI_NO_F64
    if (precision == PERI_PRECISION_DOUBLE) return "PERI_NO_F64";
#endif
#ifdef PERI_NO_MIXED
    if (precision == PERI_PRECISION_MIXED) return "PERI_NO_MIXED";
#endif
#ifdef PERI_NO_F32
    if (precision == PERI_PRECISION_SINGLE) return "PERI_NO_F32";
#endif
    (void)precision;
    return NULL;
}

static int32_t peri__check_desc(const peri_body_desc *desc, peri_error *error) {
    if (!desc) return peri__set_error(error, PERI_ERROR_ARGUMENT, "desc", -1, 0.0);
    if (desc->cookie != PERI_COOKIE_BODY) return peri__set_error(error, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    const int32_t status = peri__check_choices(desc, error);
    if (status < 0) return status;
    const char *without = peri__without_space(desc->space);
    if (!without) without = peri__without_precision(desc->precision);
    if (without) return peri__set_error(error, PERI_ERROR_LEFT_OUT, without, -1, 0.0);
    if (!(desc->horizon > 0.0 && peri__finite(desc->horizon)))
        return peri__set_error(error, PERI_ERROR_RANGE, "horizon", -1, desc->horizon);
    if (!(desc->thickness > 0.0 && peri__finite(desc->thickness)))
        return peri__set_error(error, PERI_ERROR_RANGE, "thickness", -1, desc->thickness);
    return PERI_OK;
}

/* The hooks of a descriptor; those of C where they are NULL. */
static peri__memory peri__hooks(peri_allocate_fn allocate, peri_release_fn release, void *user) {
    peri__memory memory;
    memory.allocate = allocate ? allocate : peri__malloc;
    memory.release = release ? release : peri__free;
    memory.user = user;
    memory.taken = NULL;
    return memory;
}

/* The progress of a body at its start, when all it has gone through is `cut` (directed) bonds of initial cracks. */
static peri__progress peri__at_start(int64_t cut) {
    peri__progress now;
    memset(&now, 0, sizeof now);
    now.cut = cut;
    now.load_factor = now.stiffer = 1.0;
    now.stale = PERI__STALE_FORCE | PERI__STALE_SHARP;
    return now;
}

/* b is all zero. */
static void peri__start_body(peri_body *b, const peri_body_desc *desc) {
    b->desc = *desc;
    b->memory = b->scratch = peri__hooks(desc->allocate, desc->release, desc->memory_user);
    b->scratch.taken = &b->taken;
    b->dim = desc->space == PERI_SPACE_SOLID ? 3 : 2;
    b->f32 = desc->precision == PERI_PRECISION_SINGLE;
    b->b32 = desc->precision != PERI_PRECISION_DOUBLE;
    b->number = desc->number > 0 ? desc->number : peri__number_of(b);
    b->now = peri__at_start(0);
    b->law_bad = -1;
    b->least_strength = b->row_sum_factor = 1.0;
    (void)peri__set_error(&b->error, PERI_OK, "", -1, 0.0);
}

PERI_API int32_t peri_body_create(const peri_body_desc *desc, peri_body **body, peri_error *error) {
    (void)peri__set_error(error, PERI_OK, "", -1, 0.0);
    if (body) *body = NULL;
    if (desc && !body) return peri__set_error(error, PERI_ERROR_ARGUMENT, "body", -1, 0.0);
    int32_t status = peri__check_desc(desc, error);
    if (status < 0) return status;
    peri__memory memory = peri__hooks(desc->allocate, desc->release, desc->memory_user);
    peri_body *b = (peri_body *)peri__new(&memory, 1, sizeof *b);
    if (!b) return peri__set_error(error, PERI_ERROR_MEMORY, "body", -1, 0.0);
    peri__start_body(b, desc);
    *body = b;
    return PERI_OK;
}

/* ---- the shared model --------------------------------------------------------------------------------------------- */

static void peri__free_list(const peri_body *b, peri__model *m) {
    peri__free_model_arrays(b, m, PERI_LIST_ARRAYS);
    m->entries = 0;
}

static void peri__release_model(const peri_body *b, peri__model *m) {
    const peri__memory memory = m->memory;
    if (peri__count_users(&m->users, -1) > 0) return;
    peri__free_model_arrays(b, m, PERI_MODEL_ARRAYS);
    peri__delete(&memory, m, 1, sizeof *m);
}

/* What a material that is used asks of the body. */
static void peri__note_law(peri__model *m, const peri__law *law, int32_t criterion) {
    m->seen_by |= peri__seen_by(criterion);
    if (m->law != 0 && m->law != law->kind) m->mixed = 1;
    m->pairwise = law->pairwise && (m->law == 0 || m->pairwise);
    m->gathers |= law->gather;
    m->gauge = law->gauge;
    m->law = law->kind;
}

/* Are the modulus and density of material i, in those of the body, within what bonds and states can be reckoned with? */
static int32_t peri__check_contrast(peri_body *b, const peri__model *m, int32_t i) {
    const double least = b->b32 ? 1e-25 : 1e-250, light = b->f32 ? 1e-25 : 1e-250;
    if (!(m->laws[i].young > least)) return peri__fail(b, PERI_ERROR_RANGE, "young", i, m->laws[i].young);
    return m->rho[i] > light && m->rho[i] < 1.0 / light ? PERI_OK : peri__fail(b, PERI_ERROR_RANGE, "density", i, m->rho[i]);
}

/* Units of stress and density, and the constants of all pairs of materials in them. */
static int32_t peri__fill_pairs(peri_body *b, peri__model *m, const uint8_t *used) {
    int32_t n = b->material_count;
    peri__pair own[PERI_MATERIAL_LIMIT];
    m->materials = n;
    m->pairs = (peri__pair *)peri__new(&m->memory, (int64_t)n * n, sizeof *m->pairs);
    if (!m->pairs) return peri__fail(b, PERI_ERROR_MEMORY, "materials", -1, 0.0);
    m->density = HUGE_VAL;
    for (int32_t i = 0; i < n; ++i) { /* a material that no point has may have any numbers */
        double young = peri__young(&b->materials[i], b->desc.space), density = b->materials[i].density;
        if (used[i] && young > m->stress) m->stress = young;
        if (used[i] && density < m->density) m->density = density;
    }
    int32_t status = peri__fill_units(b, m);
    if (status < 0) return status;
    for (int32_t i = 0; i < n; ++i) {
        m->rho[i] = used[i] ? b->materials[i].density / m->density : 1.0;
        m->laws[i] = peri__law_of(&b->materials[i], b->desc.space, m->stress);
        if (used[i]) status = peri__check_contrast(b, m, i);
        if (status < 0) return status;
        if (used[i]) peri__note_law(m, &m->laws[i], b->materials[i].criterion);
        if (used[i]) peri__note_inelastic(m, i, &b->materials[i]);
        if (used[i] && peri__is_soft(b, &m->laws[i], 0.5 * m->spacing / m->horizon))
            peri__log(b, 1, "Oterkus: at this Poisson ratio the spring of whole families is held back: shear is softer than asked for");
        status = peri__constants(b, &b->materials[i], m->stress, m->length, 0.5 * m->spacing / m->horizon, &own[i]);
        if (status < 0) return status;
    }
    for (int64_t k = 0; k < b->interface_count; ++k)
        if (used[b->interfaces[k].i] && used[b->interfaces[k].j]) m->seen_by |= peri__seen_by(b->interfaces[k].material.criterion);
    for (int32_t i = 0; i < n; ++i)
        for (int32_t j = 0; j < n; ++j) {
            peri__pair *pair = &m->pairs[i * n + j];
            status = peri__pair_constants(b, i, j, m->stress, m->length, 0.5 * m->spacing / m->horizon, own, pair);
            if (status < 0) return status;
            if (peri__is_breakable(pair)) m->breakable = 1;
            m->criteria |= peri__criteria_of(pair);
        }
    return PERI_OK;
}

/* Families and weights by the list. */
static int32_t peri__fill_list(peri_body *b, peri__model *m, peri__cloud *cloud, peri__sums *sums) {
    const int corrects = peri__corrects(b, m);
    int32_t status = b->setup.ibond ? peri__take_families(b, cloud) : peri__write_families(b, cloud, corrects);
    if (status == PERI_OK && b->setup.ibond) status = peri__check_families(b, m);
    if (status == PERI_OK) status = peri__weigh(b, cloud, sums);
    if (status == PERI_OK && b->setup.ibond) status = peri__check_agreement(b, cloud);
    if (status == PERI_OK) status = peri__correct(b, cloud, sums);
    if (status < 0 || !m->pairwise || (cloud->weighs && !corrects)) return status;
    peri__for_points(b, m->points, m->width, peri__row_sum_block, cloud, sums);
    for (int64_t k = 0; k < m->blocks; ++k)
        if (sums[k].a > m->row_sum) m->row_sum = sums[k].a;
    return PERI_OK;
}

/* The same of a part: all have columns, or all rows by points. Those columns that a list would lead to are the same. */
static int32_t peri__fill_part(peri_body *b, peri__model *m, peri__cloud *cloud, peri__sums *sums) {
    double listed = peri__corrects(b, m) || !peri__is_lattice_part(b);
    int32_t status = peri__check_part(b, m);
    if (status == PERI_OK) status = peri__count_families(b, cloud);
    if (status == PERI_OK) status = peri__check_families(b, m);
    if (status == PERI_OK) status = peri__agree(b, PERI_OK, 1, &listed);
    if (status == PERI_OK && listed == 0.0) {
        const int32_t made = peri__build_stencil(b, cloud);
        listed = made == 0;
        status = made < 0 ? made : peri__agree(b, PERI_OK, 1, &listed);
        if (listed > 0.0) peri__free_stencil(m);
    }
    if (status == PERI_OK && listed > 0.0) status = peri__fill_list(b, m, cloud, sums);
    if (status < 0) return status;
    peri__find_depths(m);
    return PERI_OK;
}

/* Families and weights: by columns from the points, or by the list and, where that pays, columns from it. */
static int32_t peri__fill_families(peri_body *b, peri__model *m, peri__cloud *cloud, peri__sums *sums) {
    int32_t listed = b->setup.ibond || peri__corrects(b, m), status = PERI_OK, made = 0;
    if (m->part) return peri__fill_part(b, m, cloud, sums);
    if (!b->setup.ibond) status = peri__count_families(b, cloud);
    if (status == PERI_OK && !b->setup.ibond) status = peri__check_families(b, m);
    if (status == PERI_OK && !listed) status = made = peri__build_stencil(b, cloud);
    if (status < 0 || made) return status < 0 ? status : PERI_OK;
    status = peri__fill_list(b, m, cloud, sums);
    if (status < 0 || !listed) return status;
    made = peri__build_stencil(b, cloud);
    if (made > 0) peri__free_list(b, m);
    if (made == 0 && !b->setup.ibond) made = peri__place_rows(b, cloud);
    return made < 0 ? made : PERI_OK;
}

/* Length of a component plane: an odd number of lanes, so that planes do not share the sets of a cache. */
static int64_t peri__stride(int64_t points) { return ((points + PERI_GROUP - 1) / PERI_GROUP | 1) * PERI_GROUP; }

/* What follows from how the families are stored. */
static void peri__fit_model(const peri_body *b, peri__model *m) {
    m->margin = (m->stencil.reach + 2 * PERI_GROUP - 1) / PERI_GROUP * PERI_GROUP;
    m->words = (m->width + 31) / 32;
    if (!m->start || m->bond || b->desc.kernel == PERI_KERNEL_REFERENCE || m->seen_by & PERI__BY_ROWS) return;
    const int working = (m->seen_by & PERI__BY_WORK) != 0, by_energy = working || m->seen_by & PERI__BY_NODE_ENERGY;
    /* in mixed precision vectors and rows round lengths differently: the two ends of a bond of list_mixed would not be opposite */
    const int by_rows = m->mixed ? m->gathers & PERI__GRADIENT : m->pairwise && by_energy;
    if (!by_rows && !((m->mixed || working) && b->b32 && !b->f32))
        m->record_reals = m->gathers & PERI__GRADIENT ? (m->dim == 2 ? 12 : 16) : m->dim == 2 && m->pairwise && m->materials == 1 ? 4 : 8;
}

/* The units, and the points in them; cloud->largest: the largest edge of a cell. */
static int32_t peri__place_points(peri_body *b, peri__model *m, peri__cloud *cloud) {
    const int32_t dim = b->dim;
    peri__scale_points(b, m, cloud->x);
    for (int64_t i = 0; i < m->points; ++i) { /* extents or cells beyond the range of double */
        if (!peri__finite_vector(&cloud->x[i * dim], dim)) return peri__fail(b, PERI_ERROR_POINT, "positions", i, 0.0);
        if (!(m->volume[i] > 0.0 && peri__finite(m->volume[i]))) return peri__fail(b, PERI_ERROR_POINT, "volumes", i, m->volume[i]);
    }
    for (int64_t i = 0; i < m->points; ++i)
        for (int32_t d = 0; d < dim; ++d) peri__put_real(m->x, b->f32, d * m->stride + i, cloud->x[i * dim + d]);
    for (int64_t p = 0; p < b->setup.piece_count; ++p)
        for (int32_t d = 0; b->setup.pieces[p].lattice && d < dim; ++d) {
            double edge = b->setup.pieces[p].cell[d] / m->length;
            if (edge > cloud->largest) cloud->largest = edge;
        }
    double most = m->volume[0];
    cloud->even = most;
    for (int64_t i = 1; i < m->points; ++i) {
        if (m->volume[i] != cloud->even) cloud->even = 0.0;
        if (m->volume[i] > most) most = m->volume[i];
    }
    if (pow(most, 1.0 / dim) > cloud->largest) cloud->largest = pow(most, 1.0 / dim);
    return PERI_OK;
}

/* Points, families, weights: all that clones share. On failure the model is partly filled; the caller releases it. */
static int32_t peri__fill_model(peri_body *b, peri__model *m, peri__cloud *cloud, peri__sums *sums) {
    int32_t dim = b->dim, status;
    size_t real = peri__real(b);
    uint8_t used[PERI_MATERIAL_LIMIT] = { 0 };
    m->dim = dim;
    m->f32 = b->f32;
    m->b32 = b->b32;
    m->points = b->setup.point_count;
    m->blocks = (m->points + PERI_BLOCK - 1) / PERI_BLOCK;
    m->stride = peri__stride(m->points);
    m->x = peri__new(&m->memory, m->stride * dim, real);
    m->volume = (double *)peri__new(&m->memory, m->points, sizeof *m->volume);
    m->material = (uint8_t *)peri__copy(&m->memory, b->setup.material, m->points, 1);
    m->count = (int32_t *)peri__new(&m->memory, m->points, sizeof *m->count);
    m->piece_count = b->setup.piece_count;
    m->pieces = (peri__piece *)peri__copy(&m->memory, b->setup.pieces, m->piece_count, sizeof *m->pieces);
    for (int64_t p = 0; m->pieces && p < m->piece_count; ++p) m->pieces[p].vertices = NULL, m->pieces[p].shapes = NULL;
    if (!m->x || !m->volume || !m->material || !m->count || !m->pieces) return peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);

    if (b->setup.part) {
        m->part = peri__new_part(&m->memory, &b->setup.part->desc, b->setup.part->points);
        m->part_bytes = m->part ? m->part->bytes : 0;
        if (!m->part) return peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
    }
    status = peri__place_points(b, m, cloud);
    for (int64_t i = 0; i < m->points; ++i) used[m->material[i]] = 1;
    if (status == PERI_OK && m->part) status = peri__agree_on_points(b, m, used, &cloud->even);
    if (status < 0) return status;
    m->mutual = b->b32 && !(cloud->even > 0.0);
    if (m->mutual) m->portion = peri__new(&m->memory, m->stride, real);
    if (m->mutual && !m->portion) return peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
    for (int64_t i = 0; m->mutual && i < m->points; ++i) peri__put_real(m->portion, b->f32, i, 1.0 / m->volume[i]);
    peri__gauss(cloud->gauss_x, cloud->gauss_w);

    status = peri__fill_pairs(b, m, used);
    if (status == PERI_OK && m->inelastic && m->seen_by) status = peri__fail(b, PERI_ERROR_CRITERION, "criterion", -1, 0.0);
    cloud->edge = 0.5 * m->spacing / m->horizon;
    if (status == PERI_OK) status = peri__fill_families(b, m, cloud, sums);
    if (status == PERI_OK && m->pairwise && !(m->row_sum > 1e-30 && m->row_sum < 1e30))
        status = peri__fail(b, PERI_ERROR_RANGE, "horizon", -1, b->desc.horizon);
    m->stencil.isa = peri__isa(b->desc.instructions);
    peri__fit_model(b, m);
    return status;
}

/* Vectors with their margins, of b->memory or b->scratch. */
static void *peri__new_vector(const peri_body *b, const peri__memory *memory) {
    char *vector = (char *)peri__new(memory, peri__vector_reals(b->model), peri__real(b));
    return vector ? vector + (size_t)b->model->margin * peri__real(b) : NULL;
}

static void peri__delete_vector(const peri_body *b, const peri__memory *memory, void *vector) {
    if (!vector) return;
    peri__delete(memory, (char *)vector - (size_t)b->model->margin * peri__real(b), peri__vector_reals(b->model), peri__real(b));
}

/* ---- state -------------------------------------------------------------------------------------------------------- */

/* What an obstacle holds; it may be half made. */
static void peri__free_obstacle(const peri_body *b, peri__obstacle *o) {
    peri__delete(&b->memory, o->solid.mesh, o->solid.mesh ? o->solid.mesh->bytes : 0, 1);
    peri__delete(&b->memory, o->free, 1, sizeof *o->free);
    peri__delete(&b->memory, o->kept, b->model->points * PERI_KEPT, sizeof *o->kept);
    peri__delete(&b->memory, o->tally, b->model->blocks * PERI_TALLIED, sizeof *o->tally);
    o->solid.mesh = NULL;
    o->free = NULL;
    o->kept = o->tally = NULL;
}

static void peri__free_load(const peri_body *b, peri__load *load) {
    peri__delete(&b->memory, load->value, load->count * b->dim, sizeof(double));
    peri__delete(&b->memory, load->force, PERI__SUPPORT_PLANES * load->count * b->dim, sizeof(double));
    peri__delete(&b->memory, load->spread, load->count * b->dim * b->dim, sizeof(double));
    peri__delete(&b->memory, load->owned, load->count, 1);
    peri__delete(&b->memory, load->all, load->count, sizeof *load->all);
    load->value = load->force = load->spread = NULL;
    load->owned = NULL;
    load->all = NULL;
}

/* Of what solves leave to the next ones: blocks that are listed, so that all of it is counted and freed without a look at it. */
static peri__memory peri__lasting(const peri_body *b) {
    peri__memory memory = b->memory;
    memory.taken = (peri__taken **)&b->keeping;
    return memory;
}

static void peri__forget_solver(peri_body *b) {
    const peri__memory memory = peri__lasting(b);
    if (b->keeping) peri__delete_all_taken(&memory);
    b->kept = NULL;
}

static void peri__free_state(peri_body *b) {
    const peri__memory *memory = &b->memory;
    const peri__model *m = b->model;
    void **vectors[3] = { &b->u, &b->v, &b->f };
    peri__forget_solver(b);
    for (int k = 0; k < 3; ++k) {
        peri__delete_vector(b, memory, *vectors[k]);
        *vectors[k] = NULL;
    }
    peri__array arrays[PERI_ARRAYS];
    peri__list_arrays(b, arrays);
    for (int k = 0; k < PERI_ARRAYS; ++k) {
        peri__delete(memory, peri__array_of(b, &arrays[k]), arrays[k].count, arrays[k].size);
        peri__set_array(b, &arrays[k], NULL);
    }
    for (int k = 0; k < peri__count_field; ++k) {
        peri__delete(memory, b->derived[k].data, m->points * b->derived[k].components, sizeof(double));
        b->derived[k].data = NULL;
    }
    for (int64_t k = 0; k < b->set_count; ++k) {
        peri__delete(memory, b->sets[k].name, b->sets[k].name_bytes, 1);
        peri__delete(memory, b->sets[k].points, b->sets[k].all, sizeof(int32_t));
    }
    peri__delete(memory, b->sets, b->set_capacity, sizeof *b->sets);
    for (int64_t k = 0; k < b->load_count; ++k) peri__free_load(b, &b->loads[k]);
    peri__delete(memory, b->loads, b->load_capacity, sizeof *b->loads);
    for (int64_t k = 0; k < b->obstacle_count; ++k) peri__free_obstacle(b, &b->obstacles[k]);
    peri__delete(memory, b->obstacles, b->obstacle_capacity, sizeof *b->obstacles);
    peri__free_contact(b, b->contact);
    b->contact = NULL;
    b->sets = NULL;
    b->loads = NULL;
    b->obstacles = NULL;
    b->set_count = b->load_count = b->obstacle_count = 0;
    b->set_capacity = b->load_capacity = b->obstacle_capacity = 0;
}

/* Sets one flag per bond: n bonds of row i in the first n bits, nothing in the rest. */
static void peri__set_flags(const peri__model *m, uint32_t *flags) {
    for (int64_t i = 0; i < m->points; ++i)
        for (int32_t w = 0, left = m->count[i]; w < m->words; ++w, left -= 32)
            flags[i * m->words + w] = left >= 32 ? ~(uint32_t)0 : left > 0 ? ((uint32_t)1 << left) - 1 : 0;
}

static uint32_t *peri__new_flags(const peri_body *b) {
    const peri__model *m = b->model;
    uint32_t *flags = (uint32_t *)peri__new(&b->memory, m->points * m->words, sizeof *flags);
    if (flags) peri__set_flags(m, flags);
    return flags;
}

/* Flags of live bonds, by rows and by columns, taken when something can break or is cut. 0 where memory is short. */
static int peri__need_alive(peri_body *b) {
    uint32_t *alive;
    uint16_t *columns = NULL;
    if (b->alive) return 1;
    alive = peri__new_flags(b);
    if (b->model->stencil.columns)
        columns = (uint16_t *)peri__new(&b->memory, b->model->stencil.columns, sizeof *columns);
    if (!alive || (b->model->stencil.columns && !columns)) {
        peri__delete(&b->memory, alive, b->model->points * b->model->words, sizeof *alive);
        peri__delete(&b->memory, columns, b->model->stencil.columns, sizeof *columns);
        return 0;
    }
    if (columns) peri__whole_masks(b->model, columns);
    b->alive = alive;
    b->masks = columns;
    return 1;
}

/* Classes of points: material, and material + materials where the point cannot fail. A bond with a no-fail end never breaks. */
static int32_t peri__update_classes(peri_body *b) {
    const peri__model *m = b->model;
    int32_t n = m->materials;
    if (!b->point_class && (n > 1 || b->no_fail)) {
        b->point_class = (uint8_t *)peri__new(&b->memory, m->points, 1);
        if (!b->point_class) return peri__fail(b, PERI_ERROR_MEMORY, "laws", -1, 0.0);
    }
    b->classes = b->no_fail ? 2 * n : n;
    for (int32_t p = 0; p < b->classes; ++p)
        for (int32_t q = 0; q < b->classes; ++q) {
            peri__pair *pair = &b->pairs[p * b->classes + q];
            *pair = m->pairs[p % n * n + q % n];
            for (int32_t k = 0; (p >= n || q >= n) && k < peri__count_criterion; ++k) pair->s0 = pair->limit[k] = PERI_NEVER;
        }
    for (int64_t i = 0; b->point_class && i < m->points; ++i)
        b->point_class[i] = (uint8_t)(m->material[i] + (b->no_fail && b->no_fail[i] ? n : 0));
    return PERI_OK;
}

static int32_t peri__new_state(peri_body *b) {
    const peri__model *m = b->model;
    b->ops = b->f32 ? (b->dim == 3 ? &peri__ops_f3 : &peri__ops_f2)
           : b->b32 ? (b->dim == 3 ? &peri__ops_m3 : &peri__ops_m2)
                    : b->dim == 3 ? &peri__ops_d3 : &peri__ops_d2;
    b->u = peri__new_vector(b, &b->memory);
    b->v = peri__new_vector(b, &b->memory);
    b->f = peri__new_vector(b, &b->memory);
    if (!b->u || !b->v || !b->f || (m->breakable && !peri__need_alive(b)) || !peri__need_arrays(b))
        return peri__fail(b, PERI_ERROR_MEMORY, "state", -1, 0.0);
    peri__find_mirrors(b);
    int32_t status = peri__update_classes(b);
    if (status == PERI_OK && m->part) status = peri__compare_ghosts(b);
    if (status < 0 || m->pairwise) return status < 0 || !m->part ? status : peri__agree(b, status, 1, &b->model->row_sum);
    b->now.stale |= PERI__STALE_CONSTANTS;
    peri__refresh(b);
    status = peri__agree(b, status, 1, &b->largest_row_sum);
    if (status < 0) return status;
    b->model->row_sum = b->largest_row_sum; /* of the whole body: broken bonds may only raise it */
    return b->largest_row_sum > 1e-30 && b->largest_row_sum < 1e30 ? PERI_OK
                                                                    : peri__fail(b, PERI_ERROR_RANGE, "horizon", -1, b->desc.horizon);
}

/* Ends a build that failed, or that was left: the body is as before it. */
static void peri__drop_build(peri_body *b) {
    if (!b->building) return;
    if (b->model) peri__free_state(b);
    peri__drop_sorted(b->building);
    peri__release_model(b, b->building);
    b->model = b->building = NULL;
}

static void peri__free_cloud(const peri_body *b, peri__cloud *cloud, int64_t points) {
    peri__delete(&b->scratch, cloud->x, points * b->dim, sizeof(double));
    peri__free_cells(cloud);
}

/* Families, then the state. What is made is reached from b->building, or taken of b->scratch. */
static int32_t peri__make_model(peri_body *b) {
    const int64_t points = b->setup.point_count, blocks = (points + PERI_BLOCK - 1) / PERI_BLOCK;
    peri__cloud cloud;
    peri__model *m = (peri__model *)peri__new(&b->memory, 1, sizeof *m);
    if (!m) return peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
    b->building = m;
    m->memory = b->memory;
    m->users = 1;
    memset(&cloud, 0, sizeof cloud);
    cloud.body = b;
    cloud.model = m;
    cloud.x = (double *)peri__new(&b->scratch, points * b->dim, sizeof(double));
    peri__sums *sums = (peri__sums *)peri__new(&b->scratch, blocks, sizeof *sums);
    int32_t status = cloud.x && sums ? peri__fill_model(b, m, &cloud, sums) : peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
    status = peri__heed_influence(b, status);
    peri__free_cloud(b, &cloud, points);
    if (status == PERI_OK) {
        b->model = m;
        status = peri__check_span(b, sums);
        if (status == PERI_OK) status = peri__fit_bond_laws(b);
        if (status == PERI_OK) status = peri__new_state(b);
    }
    peri__delete(&b->scratch, sums, blocks, sizeof *sums);
    return status;
}

PERI_API int32_t peri_build(peri_body *b) {
    PERI_NEED_UNBUILT(b);
    if (b->material_count == 0) return peri__fail(b, PERI_ERROR_MATERIAL, "material", -1, 0.0);
    if (b->setup.point_count == 0) return peri__fail(b, PERI_ERROR_EMPTY, "points", -1, 0.0);
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    b->told = 0;
    const int32_t status = peri__tell_parts(b, peri__make_model(b));
    peri__leave(b, former);
    if (status < 0) {
        peri__drop_build(b);
        return status;
    }
    b->building = NULL;
    peri__free_setup(b);
    return PERI_OK;
}

PERI_API void peri_body_destroy(peri_body *b) {
    peri__memory memory;
    if (!b) return;
    if (b->running) {
        peri__log(b, 1, "peri_body_destroy from a callback of the body: ignored");
        return;
    }
    memory = b->memory;
    peri__leave_world(b);
    if (b->model) {
        peri__free_state(b);
        peri__release_model(b, b->model);
    }
    peri__free_setup(b);
    peri__delete(&memory, b->interfaces, b->interface_capacity, sizeof *b->interfaces);
    peri__delete(&memory, b->bond_laws, b->bond_law_capacity, sizeof *b->bond_laws);
    peri__delete(&memory, b, 1, sizeof *b);
}
