/* SPDX-License-Identifier: MIT */
/* part.c - bodies that are parts of larger ones: what they ask each other, and the displacement of ghosts.

   All parts make the same calls, and meet in the hooks in the same order. Reductions come in one form, peri__agree: the maxima of a fixed
   number of values, the first of which is the status. A part that fails between two of them ends its call by the next one, with its
   status (peri__tell_parts), so all end there with it and none waits; sums follow an agreement at once. Within a step a part that fails
   before the exchange still makes it.

   Forces have the same bits for every partition: a part works out its own points from ghosts, and nothing is added back. What they are
   summed in follows: bonds by ascending points; whether families are stored by columns, whether volumes differ and which materials are in
   use are agreed, and coordinates of lattices are such that differences are exact (peri__snapped). A bond breaks by the displacements of
   its ends alone, so that both parts that have it find the same; of state-based laws the responses of ghosts of depth 1 are needed, and
   so are the bonds that these lose. Criteria that look at the families of both ends would need another exchange, and are refused.

   At a break within a step the ordinary laws share the mean moment of a quarter of the step (failure.c), which is a sum over all parts.
   Parts take the middle of a sixteenth instead. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_PART (UINT64_C(0x70657269000F0000) + sizeof(peri_part_desc))
#define PERI_AGREED 5 /* values of an agreement beside the status                                                       */

/* ---- what a body keeps of it --------------------------------------------------------------------------------------- */

/* A block of memory with all arrays, filled from those of the descriptor; NULL where memory is short. */
static peri__domain *peri__new_part(const peri__memory *memory, const peri_part_desc *d, int64_t points) {
    const int64_t ghosts = d->ghost_count, blocks = (points + PERI_BLOCK - 1) / PERI_BLOCK, owned = points - ghosts;
    const size_t words = sizeof(int64_t) * (size_t)(1 + (d->ids ? points : 0)), ints = sizeof(int32_t) * (size_t)(2 * ghosts + owned);
    const int64_t bytes = (int64_t)(sizeof(peri__domain) + words + ints + (size_t)(points + 2 * blocks));
    char *at = (char *)peri__new(memory, bytes, 1);
    peri__domain *p = (peri__domain *)(void *)at;
    if (!p) return NULL;
    p->desc = *d;
    p->bytes = bytes;
    p->points = points;
    p->blocks = blocks;
    p->ids = (int64_t *)(void *)(at += (sizeof *p + sizeof(int64_t) - 1) / sizeof(int64_t) * sizeof(int64_t));
    p->ghosts = (int32_t *)(void *)(p->ids + (d->ids ? points : 0));
    p->owners = p->ghosts + ghosts;
    p->owned = p->owners + ghosts;
    p->depth = (uint8_t *)(p->owned + owned);
    p->force_skip = p->depth + points;
    p->gather_skip = p->force_skip + blocks;
    for (int64_t i = 0; d->ids && i < points; ++i) p->ids[i] = d->ids[i];
    for (int64_t k = 0; k < ghosts; ++k) {
        p->ghosts[k] = d->ghosts[k];
        p->owners[k] = d->owners ? d->owners[k] : -1;
    }
    for (int64_t i = 0, k = 0, n = 0; i < points; ++i) {
        if (k < ghosts && p->ghosts[k] == i) p->depth[i] = PERI_DEEPEST, ++k;
        else p->owned[n++] = (int32_t)i;
    }
    p->desc.ghosts = p->ghosts;
    p->desc.owners = p->owners;
    if (d->ids) p->desc.ids = p->ids;
    else p->ids = NULL;
    return p;
}

PERI_API void peri_part_desc_init(peri_part_desc *d) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_PART;
}

/* Are ghosts points, ascending, and owners points that are none? */
static int32_t peri__check_ghosts(peri_body *b, const peri_part_desc *d, int64_t points) {
    int elsewhere = 0;
    if (d->ghost_count < 0 || d->ghost_count >= points) return peri__fail(b, PERI_ERROR_RANGE, "ghost_count", -1, (double)d->ghost_count);
    PERI_NEED(b, d->ghosts || d->ghost_count == 0, "ghosts");
    for (int64_t k = 0; k < d->ghost_count; ++k)
        if (d->ghosts[k] < 0 || d->ghosts[k] >= points || (k > 0 && d->ghosts[k] <= d->ghosts[k - 1]))
            return peri__fail(b, PERI_ERROR_INDEX, "ghosts", k, d->ghosts[k]);
    for (int64_t k = 0; k < d->ghost_count; ++k) {
        const int64_t owner = d->owners ? d->owners[k] : -1;
        int64_t lo = 0, hi = d->ghost_count;
        elsewhere |= owner == -1;
        while (lo < hi) {
            const int64_t middle = (lo + hi) / 2;
            if (d->ghosts[middle] < owner) lo = middle + 1;
            else hi = middle;
        }
        if (owner < -1 || owner >= points || (lo < d->ghost_count && d->ghosts[lo] == owner))
            return peri__fail(b, PERI_ERROR_INDEX, "owners", k, (double)owner);
    }
    for (int64_t i = 1; d->ids && i < points; ++i)
        if (d->ids[i] <= d->ids[i - 1]) return peri__fail(b, PERI_ERROR_INDEX, "ids", i, (double)d->ids[i]);
    PERI_NEED(b, d->exchange || !elsewhere, "exchange");
    return PERI_OK;
}

PERI_API int32_t peri_set_part(peri_body *b, const peri_part_desc *desc) {
    PERI_NEED_UNBUILT(b);
    PERI_NEED(b, desc, "desc");
    const int64_t points = b->setup.point_count;
    if (desc->cookie != PERI_COOKIE_PART) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    if (points == 0) return peri__fail(b, PERI_ERROR_EMPTY, "points", -1, 0.0);
    for (int32_t d = 0; d < b->dim; ++d)
        if (!peri__finite(desc->origin[d])) return peri__fail(b, PERI_ERROR_RANGE, "origin", d, desc->origin[d]);
    PERI_NEED_NUMBER(b, desc->length > 0.0, desc->length);
    for (int64_t k = 0; k < b->setup.piece_count; ++k) { /* coordinates of lattices are rounded in it: peri__snapped */
        const peri__piece *piece = &b->setup.pieces[k];
        for (int32_t d = 0; piece->lattice && d < b->dim; ++d)
            if (!(piece->cell[d] >= desc->length / 16.0 && piece->cell[d] <= desc->length * 16.0))
                return peri__fail(b, PERI_ERROR_RANGE, "length", -1, desc->length);
    }
    PERI_NEED_NUMBER(b, desc->mean_volume > 0.0, desc->mean_volume);
    const int32_t status = peri__check_ghosts(b, desc, points);
    if (status < 0) return status;
    peri__domain *part = peri__new_part(&b->memory, desc, points);
    if (!part) return peri__fail(b, PERI_ERROR_MEMORY, "ghosts", -1, 0.0);
    peri__delete(&b->memory, b->setup.part, b->setup.part ? b->setup.part->bytes : 0, 1);
    b->setup.part = part;
    return PERI_OK;
}

/* What is not for parts; the field is the call. */
#define PERI_NEED_WHOLE(b, name)                                                                                       \
    if ((b)->model->part) return peri__fail((b), PERI_ERROR_PART, name, -1, 0.0)

PERI_API int32_t peri_ghost_depth(const peri_body *b) {
    int32_t depth = 1;
    PERI_NEED_BODY(b);
    for (int32_t k = 0; k < b->material_count; ++k)
        if (!peri__law_of(&b->materials[k], b->desc.space, 1.0).pairwise) depth = 2;
    return b->desc.correction != PERI_CORRECTION_NONE ? 2 : depth;
}

/* ---- hooks ------------------------------------------------------------------------------------------------------------ */

static const peri__domain *peri__part_of(const peri_body *b) { return b->model ? b->model->part : b->setup.part; }

static int32_t peri__reduce(peri_body *b, int32_t reduction, int64_t count, double *values) {
    const peri__domain *p = peri__part_of(b);
    if (!p || !p->desc.reduce) return PERI_OK;
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    const int32_t said = p->desc.reduce(p->desc.user, reduction, count, values);
    peri__leave(b, former);
    return said ? peri__fail(b, PERI_ERROR_CALLBACK, "peri_reduce_fn", -1, said) : PERI_OK;
}

/* The status of this part, or of one that has failed; most[count], or NULL, become the largest of all parts. Of a whole body nothing. */
static int32_t peri__agree(peri_body *b, int32_t status, int count, double *most) {
    double values[1 + PERI_AGREED] = { 0.0 };
    const peri_error error = b->error;
    if (!peri__part_of(b) || !peri__part_of(b)->desc.reduce) return status;
    if (status < 0) values[0] = -status;
    for (int k = 0; k < count; ++k) values[1 + k] = most[k];
    const int32_t reduced = peri__reduce(b, PERI_REDUCTION_MAX, 1 + PERI_AGREED, values);
    b->told = status < 0 || reduced < 0 || values[0] > 0.0;
    if (status < 0) b->error = error; /* its own comes first */
    if (status < 0 || reduced < 0) return status < 0 ? status : reduced;
    if (values[0] > 0.0) return peri__fail(b, -(int32_t)values[0], "peri_set_part", -1, 0.0);
    for (int k = 0; k < count; ++k) most[k] = values[1 + k];
    return status;
}

/* At the end of a collective call whose parts do not meet after their last exchange: all have its status. */
static int32_t peri__end_together(peri_body *b, int32_t status) {
    if (!b->told) status = peri__agree(b, status, 0, NULL);
    b->told = 0;
    return status;
}

/* At the end of a collective call: tells the other parts, which wait for it, that this one has failed. */
static int32_t peri__tell_parts(peri_body *b, int32_t status) {
    if (status < 0 && !b->told) (void)peri__agree(b, status, 0, NULL);
    b->told = 0;
    return status;
}

/* The sums over all parts, where all of them come to this with PERI_OK. */
static int32_t peri__sum_parts(peri_body *b, int32_t status, int64_t count, double *values) {
    status = peri__agree(b, status, 0, NULL);
    return status < 0 ? status : peri__reduce(b, PERI_REDUCTION_SUM, count, values);
}

/* The same where a total is read: within a step, where one part alone may ask, it stays that of the part. */
static int32_t peri__share_total(peri_body *b, int32_t status, int64_t count, double *total) {
    if (b->running > PERI__IN_FRAME || !peri__part_of(b)) return status;
    b->told = 0;
    return peri__tell_parts(b, status < 0 ? status : peri__sum_parts(b, status, count, total));
}

/* ---- ghosts ------------------------------------------------------------------------------------------------------------ */

/* Ghosts have no velocity and no force but within the passes that make them. */
static void peri__still_ghosts(peri_body *b) {
    const peri__model *m = b->model;
    for (int64_t k = 0; m->part && k < m->part->desc.ghost_count; ++k)
        for (int32_t d = 0; d < m->dim; ++d) {
            peri__put_real(b->v, b->f32, d * m->stride + m->part->ghosts[k], 0.0);
            peri__put_real(b->f, b->f32, d * m->stride + m->part->ghosts[k], 0.0);
        }
}

/* Images have what their owners have; to displacements the mean gradient adds. */
static void peri__copy_images(const peri_body *b, void *vector, int displacement) {
    const peri__model *m = b->model;
    const peri__domain *p = m->part;
    for (int64_t k = 0; k < p->desc.ghost_count; ++k) {
        const int64_t g = p->ghosts[k], o = p->owners[k];
        if (o < 0) continue;
        for (int32_t d = 0; d < m->dim; ++d) {
            double jump = 0.0;
            for (int32_t e = 0; displacement && e < m->dim; ++e)
                jump += b->mean_gradient[d * m->dim + e] * (peri__get_real(m->x, b->f32, e * m->stride + g)
                                                            - peri__get_real(m->x, b->f32, e * m->stride + o));
            peri__put_real(vector, b->f32, d * m->stride + g, peri__get_real(vector, b->f32, d * m->stride + o) + jump);
        }
    }
}

/* The first `planes` components of u and v to ghosts of other parts; v may be NULL. */
static int32_t peri__share_vectors(peri_body *b, int32_t planes, void *u, void *v) {
    const peri__model *m = b->model;
    void *plane[6];
    if (!m->part || !m->part->desc.exchange) return PERI_OK;
    for (int32_t k = 0; k < planes; ++k)
        plane[k] = (char *)(k < m->dim ? u : v) + (size_t)(k % m->dim * m->stride) * peri__real(b);
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    const int32_t said = m->part->desc.exchange(m->part->desc.user, b->f32 ? PERI_TYPE_F32 : PERI_TYPE_F64, planes, plane);
    peri__leave(b, former);
    return said ? peri__fail(b, PERI_ERROR_CALLBACK, "peri_exchange_fn", -1, said) : PERI_OK;
}

/* Displacements of ghosts, and where bonds may break velocities, too: by those the moment of a break is known. */
static int32_t peri__share_planes(peri_body *b, int32_t planes) {
    if (!b->model->part) return PERI_OK;
    peri__copy_images(b, b->u, 1);
    peri__copy_images(b, b->v, 0);
    return peri__share_vectors(b, planes, b->u, b->v);
}

/* A vector of the caller's to ghosts. */
static int32_t peri__share_vector(peri_body *b, void *vector, int displacement) {
    if (!b->model->part) return PERI_OK;
    peri__copy_images(b, vector, displacement);
    return peri__share_vectors(b, b->dim, vector, NULL);
}

static int32_t peri__share_ghosts(peri_body *b) { return peri__share_planes(b, b->model->breakable ? 2 * b->dim : b->dim); }

/* ---- building ---------------------------------------------------------------------------------------------------------- */

/* What parts come to be alike in before families are sought. `used`: materials; `even`: the volume of all points, or 0. */
static int32_t peri__agree_on_points(peri_body *b, peri__model *m, uint8_t *used, double *even) {
    double most[PERI_AGREED] = { *even > 0.0 ? *even : HUGE_VAL, *even > 0.0 ? -*even : HUGE_VAL, m->extent, 0.0, 0.0 };
    int32_t status = peri__agree(b, PERI_OK, PERI_AGREED, most);
    if (status < 0) return status;
    if (most[0] != -most[1]) *even = 0.0;
    m->extent = most[2];
    for (int32_t first = 0; first < b->material_count; first += PERI_AGREED) {
        double seen[PERI_AGREED] = { 0.0 };
        for (int32_t k = 0; k < PERI_AGREED && first + k < b->material_count; ++k) seen[k] = used[first + k];
        status = peri__agree(b, PERI_OK, PERI_AGREED, seen);
        if (status < 0) return status;
        for (int32_t k = 0; k < PERI_AGREED && first + k < b->material_count; ++k) used[first + k] = (uint8_t)seen[k];
    }
    return PERI_OK;
}

/* What this part cannot be. */
static int32_t peri__check_part(peri_body *b, const peri__model *m) {
    if (b->setup.ibond) return peri__fail(b, PERI_ERROR_PART, "peri_set_families", -1, 0.0);
    if (b->desc.correction == PERI_CORRECTION_EQUILIBRIUM) return peri__fail(b, PERI_ERROR_PART, "correction", -1, b->desc.correction);
    if (b->bond_law_count > 0) return peri__fail(b, PERI_ERROR_PART, "peri_set_bond_law", -1, 0.0);
    if (m->inelastic) return peri__fail(b, PERI_ERROR_PART, "peri_add_material", -1, 0.0);
    if (m->seen_by & (PERI__BY_STRESS | PERI__AND_LEAST | PERI__BY_NODE_ENERGY | PERI__BY_WORK))
        return peri__fail(b, PERI_ERROR_PART, "criterion", -1, 0.0);
    return m->points == m->part->points ? PERI_OK : peri__fail(b, PERI_ERROR_ORDER, "peri_set_part", -1, (double)m->points);
}

/* Do all pieces of this part come from lattices, so that columns serve? Whether they pay depends on the partition, and is not asked. */
static int peri__is_lattice_part(const peri_body *b) {
    int lattice = 1;
    for (int64_t p = 0; p < b->setup.piece_count; ++p) lattice &= b->setup.pieces[p].lattice && !b->setup.pieces[p].vertices;
    return lattice;
}

/* How deep ghosts are, and which blocks may be left out. */
static void peri__find_depths(const peri__model *m) {
    peri__domain *p = m->part;
    peri__row row;
    for (int depth = 0; depth + 1 < PERI_DEEPEST; ++depth)
        for (int64_t g = 0; g < p->desc.ghost_count; ++g) {
            const int64_t i = p->ghosts[g];
            if (p->depth[i] <= depth + 1) continue;
            peri__row_of(m, i, &row);
            for (int64_t k = 0; k < row.count; ++k)
                if (p->depth[row.ids[k]] == depth) p->depth[i] = (uint8_t)(depth + 1);
        }
    const int gathers = !m->pairwise, forces = !m->pairwise && m->breakable;
    memset(p->force_skip, 1, (size_t)(2 * p->blocks));
    for (int64_t i = 0; i < m->points; ++i) {
        if (p->depth[i] <= forces) p->force_skip[i / PERI_BLOCK] = 0;
        if (p->depth[i] <= gathers) p->gather_skip[i / PERI_BLOCK] = 0;
    }
}
