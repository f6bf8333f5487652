/* SPDX-License-Identifier: MIT */
/* ghosts.c - whether ghosts are as their owners: asked once, as parts are built.

   Of ghosts that other parts own the places are compared bit by bit, ids where they are given, and the sizes of families where responses
   are needed; each bond between two parts must have been found from both its ends. Of images, which are moved copies of points of the same
   body, all bonds are compared in pairs: the bond of image g of o to an owned point i is that of o to an image of i, of the same vector;
   else the two ends of a bond feel different forces, and energy is made of nothing. Missing layers are seen from the images next to them:
   where o has a neighbour of which g has no copy, though that would be within the horizon of a point that g is bonded to. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_ID_PLANES 4 /* an id as digits of 16 bits, which single precision holds                                     */

/* ---- images -------------------------------------------------------------------------------------------------------- */

/* The owner of point j where that is an image, else j, or -1 where another part owns it. */
static int64_t peri__source_of(const peri__domain *p, int64_t j) {
    int64_t lo = 0, hi = p->desc.ghost_count;
    if (!p->depth[j]) return j;
    while (lo < hi) {
        const int64_t middle = (lo + hi) / 2;
        if (p->ghosts[middle] < j) lo = middle + 1;
        else hi = middle;
    }
    return p->owners[lo];
}

/* How far places of equal points may be apart: the rounding of large coordinates, which are the caller's. */
static double peri__image_play(const peri_body *b) {
    return 1e-6 + 64.0 * (b->f32 ? (double)FLT_EPSILON : DBL_EPSILON) * b->model->extent;
}

/* Which bond of row i has the vector xi; asked from *at on, where it is mostly found. -1: none. */
static int64_t peri__bond_along(const peri_body *b, int64_t i, const peri__row *row, const double *xi, int64_t *at) {
    const peri__model *m = b->model;
    const double play = peri__image_play(b);
    for (int64_t n = 0; n < row->count; ++n) {
        const int64_t k = (*at + n) % row->count;
        double other[3], off = 0.0;
        peri__bond_of(m, m->f32, i, row->ids[k], other);
        for (int32_t d = 0; d < m->dim; ++d) off = fmax(off, fabs(other[d] - xi[d]));
        if (off > play) continue;
        *at = k + 1;
        return k;
    }
    return -1;
}

/* Is the place of point g + xi within the horizon of an owned neighbour of g? */
static int peri__is_needed(const peri_body *b, int64_t g, const peri__row *row, const double *xi) {
    const peri__model *m = b->model;
    const double reach = m->horizon - peri__image_play(b);
    for (int64_t k = 0; k < row->count; ++k) {
        double to[3], square = 0.0;
        if (m->part->depth[row->ids[k]]) continue;
        peri__bond_of(m, m->f32, g, row->ids[k], to);
        for (int32_t d = 0; d < m->dim; ++d) square += peri__square(xi[d] - to[d]);
        if (square < reach * reach) return 1;
    }
    return 0;
}

/* Is image g of o one, and is all that it needs there? */
static int peri__is_image(const peri_body *b, int64_t g, int64_t o) {
    const peri__model *m = b->model;
    const peri__domain *p = m->part;
    int64_t at = 0, back = 0;
    double xi[3];
    peri__row image, row;
    if (m->material[g] != m->material[o] || !(fabs(m->volume[g] - m->volume[o]) <= 1e-6 * m->volume[o])) return 0;
    peri__row_of(m, g, &image);
    peri__row_of(m, o, &row);
    for (int64_t k = 0; k < image.count; ++k) {
        const int64_t i = image.ids[k];
        if (p->depth[i]) continue;
        peri__bond_of(m, m->f32, g, i, xi);
        const int64_t mirror = peri__bond_along(b, o, &row, xi, &at);
        if (mirror < 0 || row.ids[mirror] == i || peri__source_of(p, row.ids[mirror]) != i) return 0;
    }
    for (int64_t k = 0; k < row.count; ++k) {
        peri__bond_of(m, m->f32, o, row.ids[k], xi);
        if (peri__bond_along(b, g, &image, xi, &back) < 0 && peri__is_needed(b, g, &image, xi)) return 0;
    }
    return 1;
}

static int32_t peri__check_images(peri_body *b) {
    const peri__domain *p = b->model->part;
    for (int64_t k = 0; k < p->desc.ghost_count; ++k)
        if (p->owners[k] >= 0 && p->depth[p->ghosts[k]] == 1 && !peri__is_image(b, p->ghosts[k], p->owners[k]))
            return peri__fail(b, PERI_ERROR_PART, "ghosts", p->ghosts[k], p->owners[k]);
    return PERI_OK;
}

/* ---- ghosts of other parts ------------------------------------------------------------------------------------------ */

/* Digit k of an id. */
static double peri__id_digit(const peri__domain *p, int64_t i, int k) {
    return p->ids ? (double)((uint64_t)p->ids[i] >> (16 * k) & 0xFFFF) : 0.0;
}

/* Have ghosts the ids that their owners gave? All parts give some, or none does. Takes u and v. */
static int32_t peri__compare_ids(peri_body *b) {
    const peri__model *m = b->model;
    const peri__domain *p = m->part;
    double most[2] = { p->ids == NULL, p->ids != NULL };
    void *const vector[2] = { b->u, b->v };
    int32_t status = peri__agree(b, PERI_OK, 2, most);
    if (status < 0 || !(most[1] > 0.0)) return status;
    if (most[0] > 0.0) return peri__fail(b, PERI_ERROR_PART, "ids", -1, 0.0);
    for (int k = 0; k < PERI_ID_PLANES; ++k)
        for (int64_t i = 0; i < m->points; ++i)
            peri__put_real(vector[k / m->dim], b->f32, k % m->dim * m->stride + i, peri__id_digit(p, i, k));
    status = peri__share_planes(b, PERI_ID_PLANES);
    for (int64_t k = 0; status == PERI_OK && k < p->desc.ghost_count; ++k)
        for (int d = 0; p->owners[k] < 0 && status == PERI_OK && d < PERI_ID_PLANES; ++d) {
            const int64_t i = p->ghosts[k], at = d % m->dim * m->stride + i;
            if (peri__get_real(vector[d / m->dim], b->f32, at) != peri__id_digit(p, i, d))
                status = peri__fail(b, PERI_ERROR_PART, "ids", i, (double)p->ids[i]);
        }
    return peri__agree(b, status, 0, NULL);
}

/* Are ghosts where their owners say they are, with as large families where these are needed? Nothing has moved yet. And has each bond of
   an owned point with a ghost been found from both its ends? It counts 1 where the ghost is above, -1 where it is below. */
static int32_t peri__compare_ghosts(peri_body *b) {
    const peri__model *m = b->model;
    const peri__domain *p = m->part;
    const int32_t needed = peri_ghost_depth(b) - 1;
    double open = 0.0;
    peri__row row;
    memcpy(b->u, m->x, (size_t)(m->stride * m->dim) * peri__real(b));
    for (int64_t i = 0; i < m->points; ++i) peri__put_real(b->v, b->f32, i, m->count[i]);
    int32_t status = peri__share_planes(b, 2 * m->dim);
    for (int64_t k = 0; status == PERI_OK && k < p->desc.ghost_count; ++k) {
        const int64_t i = p->ghosts[k];
        for (int32_t d = 0; d < m->dim && p->owners[k] < 0; ++d)
            if (peri__get_real(b->u, b->f32, d * m->stride + i) != peri__get_real(m->x, b->f32, d * m->stride + i))
                status = peri__fail(b, PERI_ERROR_PART, "ghosts", i, peri__get_real(b->u, b->f32, d * m->stride + i));
        if (p->depth[i] <= needed && peri__get_real(b->v, b->f32, i) != m->count[i])
            status = peri__fail(b, PERI_ERROR_PART, "ghosts", i, m->count[i]);
    }
    for (int64_t k = 0; k < p->desc.ghost_count; ++k) {
        const int64_t g = p->ghosts[k];
        if (p->depth[g] != 1 || p->owners[k] >= 0) continue;
        peri__row_of(m, g, &row);
        for (int64_t n = 0; n < row.count; ++n) open += p->depth[row.ids[n]] > 0 ? 0.0 : g > row.ids[n] ? 1.0 : -1.0;
    }
    if (status == PERI_OK) status = peri__check_images(b);
    if (p->desc.reduce) status = peri__sum_parts(b, status, 1, &open);
    if (status == PERI_OK) status = peri__compare_ids(b);
    memset(b->u, 0, (size_t)(m->stride * m->dim) * peri__real(b));
    memset(b->v, 0, (size_t)(m->stride * m->dim) * peri__real(b));
    if (status < 0 || !p->desc.reduce) return status;
    return open == 0.0 ? PERI_OK : peri__fail(b, PERI_ERROR_PART, "ghosts", -1, open);
}
