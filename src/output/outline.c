/* SPDX-License-Identifier: MIT */
/* outline.c - the surface of fragments, from the cells of their points.

   Cells of one lattice that lie side by side are joined where their points are in one fragment and the bond between them, if there is one,
   lives; what is not joined is drawn. A corner is shared by the cells around it that are joined to each other by sides that meet there, and
   its place is the mean of what they say. So each cell is closed, and what two cells leave out is the same on both sides: the whole is
   closed, however it is deformed. Cells that only touch at a corner share nothing, so that in 2D one side comes to a corner and one leaves.

   Where a cell says that its corner is: its point, and the offset of the corner turned and stretched with the cells joined to it. A cell
   that none is joined to keeps its directions. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_SURFACE (-1) /* a side without a neighbour, since the beginning                                              */
#define PERI_CRACK   (-2) /* a side whose neighbour it is no longer joined to                                             */

typedef struct peri__outline {
    peri_body *body;
    int32_t    fragment; /* or -1: all                                                                                    */
    int32_t    sides, corners; /* of a cell: 2 dim, 2^dim; side 2 d + 1 is that at the upper end of axis d                */
    int32_t   *side;     /* [points][sides] the point of the cell that is joined there, or one of the above               */
    int32_t   *up;       /* [points][corners] corner that this one is the same as, itself at last                         */
    int32_t   *number;   /* [points][corners] of those that are themselves: vertex, or -1                                 */
    int32_t   *leaving;  /* [points][corners] 2D: and the side that begins there                                          */
    int64_t    vertices, faces;
    int        known;    /* 1: fragments were, before the call                                                            */
} peri__outline;

/* Corners of a side in the order that has the cell on the left, or that is counter-clockwise from outside; from the lowest corner on, so
   that triangles of both sides of a crack have the same edges. */
static const uint8_t peri__edge_corners[4][2] = { { 2, 0 }, { 1, 3 }, { 0, 1 }, { 3, 2 } };
static const uint8_t peri__quad[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };

static int32_t peri__whole_corner(const peri__outline *s, int64_t slot) {
    while (s->up[slot] != slot) slot = s->up[slot] = s->up[s->up[slot]];
    return (int32_t)slot;
}

static int peri__is_drawn(const peri__outline *s, int64_t i) { return s->fragment < 0 || s->body->fragment_of[i] == s->fragment; }

/* The cells i and j lie side by side along axis d, j above. */
static void peri__join_cells(peri__outline *s, int64_t i, int64_t j, int32_t d) {
    const peri_body *b = s->body;
    const int64_t bond = peri__find_bond(b->model, i, j);
    const int joined = b->fragment_of[i] == b->fragment_of[j] && (bond < 0 || peri__is_alive(b, i, bond));
    s->side[i * s->sides + 2 * d + 1] = joined ? (int32_t)j : PERI_CRACK;
    s->side[j * s->sides + 2 * d] = joined ? (int32_t)i : PERI_CRACK;
    for (int32_t c = 0; joined && c < s->corners; ++c) {
        if (!(c >> d & 1)) continue;
        const int32_t own = peri__whole_corner(s, i * s->corners + c), other = peri__whole_corner(s, j * s->corners + (c ^ 1 << d));
        if (own < other) s->up[other] = own;
        else s->up[own] = other;
    }
}

/* Component d of where a point is in its piece, in cells. */
static double peri__in_cells(const peri_body *b, const peri__piece *piece, int64_t i, int32_t d) {
    return (peri__position(b, i, d) - piece->origin[d]) / piece->cell[d];
}

static int64_t peri__site_of(const peri_body *b, const peri__piece *piece, int64_t i) {
    int64_t site = 0;
    for (int32_t d = b->dim - 1; d >= 0; --d) {
        const int64_t index = (int64_t)floor(peri__in_cells(b, piece, i, d));
        site = site * piece->cells[d] + (index < 0 ? 0 : peri__min(index, piece->cells[d] - 1));
    }
    return site;
}

/* Points of a piece are in the order of their sites, so that those one cell further on come in that order, too. A centroid may be in the
   cell beside its own: but where vertices have moved, every site has its point. */
static void peri__join_piece(peri__outline *s, const peri__piece *piece) {
    const peri_body *b = s->body;
    const int64_t end = piece->first + piece->count;
    int64_t stride = 1;
    for (int32_t d = 0; d < b->dim; stride *= piece->cells[d++])
        for (int64_t i = piece->first, j = i; i < end; ++i) {
            const int64_t site = piece->amount > 0.0 ? i - piece->first : peri__site_of(b, piece, i);
            if (site / stride % piece->cells[d] + 1 >= piece->cells[d]) continue;
            if (piece->amount > 0.0) j = i + stride;
            else while (j < end && peri__site_of(b, piece, j) < site + stride) ++j;
            if (j < end && (piece->amount > 0.0 || peri__site_of(b, piece, j) == site + stride)) peri__join_cells(s, i, j, d);
        }
}

static void peri__number_corner(peri__outline *s, int32_t slot) {
    if (s->number[slot] < 0) s->number[slot] = (int32_t)s->vertices++;
}

/* The sides of a plane in loops, each of which ends at its first corner; the first vertex of a side has its number. */
static void peri__follow_sides(peri__outline *s, int32_t *side) {
    const int64_t points = s->body->model->points;
    for (int64_t k = 0; k < 4 * points; ++k)
        if (s->side[k] < 0 && peri__is_drawn(s, k / 4))
            s->leaving[peri__whole_corner(s, k / 4 * 4 + peri__edge_corners[k % 4][0])] = (int32_t)k;
    for (int64_t k = 0; k < 4 * points; ++k) {
        if (s->side[k] >= 0 || !peri__is_drawn(s, k / 4)) continue;
        int32_t at = (int32_t)k, corner = peri__whole_corner(s, k / 4 * 4 + peri__edge_corners[k % 4][0]);
        while (s->number[corner] < 0) {
            peri__number_corner(s, corner);
            if (side) side[s->faces] = at;
            s->faces++;
            corner = peri__whole_corner(s, at / 4 * 4 + peri__edge_corners[at % 4][1]);
            at = s->leaving[corner];
        }
    }
}

static void peri__list_sides(peri__outline *s, int32_t *side) {
    for (int64_t k = 0; k < 6 * s->body->model->points; ++k) {
        if (s->side[k] >= 0 || !peri__is_drawn(s, k / 6)) continue;
        for (int c = 0; c < 4; ++c) peri__number_corner(s, peri__whole_corner(s, k / 6 * 8 + peri__quad[k % 6][c]));
        if (side) side[s->faces / 2] = (int32_t)k;
        s->faces += 2;
    }
}

static int64_t peri__outline_ints(const peri__outline *s) {
    return s->body->model->points * (s->sides + (s->body->dim == 2 ? 3 : 2) * s->corners);
}

static int32_t peri__close_outline(peri__outline *s, int32_t status) {
    peri__delete(&s->body->scratch, s->side, peri__outline_ints(s), sizeof *s->side);
    if (status < 0) peri__forget_fragments(s->body, s->known);
    return status;
}

/* What is joined. */
static int32_t peri__open_outline(peri_body *b, int32_t fragment, peri__outline *s) {
    const peri__model *m = b->model;
    memset(s, 0, sizeof *s);
    s->body = b;
    s->known = b->fragment_of != NULL;
    const int32_t status = peri__label_fragments(b);
    if (status < 0) return status;
    if (fragment < -1 || fragment >= b->now.fragments)
        return peri__close_outline(s, peri__fail(b, PERI_ERROR_RANGE, "fragment", -1, fragment));
    s->fragment = fragment;
    s->sides = 2 * b->dim;
    s->corners = 1 << b->dim;
    if (m->points <= INT32_MAX / s->corners) /* corners are int32 */
        s->side = (int32_t *)peri__new_unset(&b->scratch, peri__outline_ints(s), sizeof *s->side);
    if (!s->side) return peri__close_outline(s, peri__fail(b, PERI_ERROR_MEMORY, "fragment", -1, 0.0));
    s->up = s->side + m->points * s->sides;
    s->number = s->up + m->points * s->corners;
    s->leaving = b->dim == 2 ? s->number + m->points * s->corners : NULL;
    for (int64_t k = 0; k < m->points * s->sides; ++k) s->side[k] = PERI_SURFACE;
    for (int64_t k = 0; k < m->points * s->corners; ++k) s->up[k] = (int32_t)k;
    for (int64_t k = 0; k < m->points * s->corners; ++k) s->number[k] = -1;
    for (int64_t p = 0; p < m->piece_count; ++p)
        if (m->pieces[p].lattice) peri__join_piece(s, &m->pieces[p]);
    return PERI_OK;
}

/* ---- places ------------------------------------------------------------------------------------------------------- */

static double peri__along_axis(const double *v, int32_t dim) { return sqrt(peri__dot(v, v, dim)); }

/* Those of the columns of F that no neighbour tells: perpendicular to the others, of length 1. */
static void peri__complete_columns(double f[3][3], const int *told, int32_t dim) {
    int count = 0, one = 0, other = 0;
    for (int32_t d = 0; d < dim; ++d) {
        count += told[d];
        if (told[d]) one = d;
        else other = d;
    }
    if (count == 0 || count == dim) return;
    const double length = peri__along_axis(f[one], dim);
    if (dim == 2) {
        f[other][0] = (other ? -f[one][1] : f[one][1]) / length;
        f[other][1] = (other ? f[one][0] : -f[one][0]) / length;
    } else if (count == 2) {
        const int32_t e = (other + 1) % 3, g = (other + 2) % 3;
        peri__cross(f[e], f[g], f[other]);
        const double area = peri__along_axis(f[other], 3);
        for (int d = 0; d < 3; ++d) f[other][d] = area > 0.0 ? f[other][d] / area : d == other;
    } else { /* the least turn that takes its axis there */
        const double cosine = f[one][one] / length;
        for (int32_t e = 0; e < 3; ++e)
            for (int32_t d = 0; e != one && d < 3; ++d) {
                const double along = ((d == one) + f[one][d] / length) * f[one][e] / length;
                f[e][d] = 1.0 + cosine > 1e-9 ? (d == e) - along / (1.0 + cosine) : d != e ? 0.0 : e == (one + 1) % 3 ? -1.0 : 1.0;
            }
    }
}

/* Columns of the deformation gradient of a cell, by the cells joined to it. */
static void peri__turn_cell(const peri__outline *s, int64_t i, double f[3][3]) {
    const peri_body *b = s->body;
    int told[3] = { 0, 0, 0 };
    for (int32_t d = 0; d < b->dim; ++d) {
        const int32_t below = s->side[i * s->sides + 2 * d], above = s->side[i * s->sides + 2 * d + 1];
        const int64_t from = below >= 0 ? below : i, to = above >= 0 ? above : i;
        const double apart = from == to ? 0.0 : peri__position(b, to, d) - peri__position(b, from, d);
        for (int32_t e = 0; e < 3; ++e) f[d][e] = d == e;
        for (int32_t e = 0; apart > 0.0 && e < b->dim; ++e) f[d][e] += (peri__moved(b, to, e) - peri__moved(b, from, e)) / apart;
        told[d] = apart > 0.0 && peri__along_axis(f[d], b->dim) > 1e-9;
        for (int32_t e = 0; !told[d] && e < 3; ++e) f[d][e] = d == e;
    }
    peri__complete_columns(f, told, b->dim);
}

/* Adds up what the cells of a piece say of its corners. shares[vertices]: how many did. */
static void peri__add_corners(const peri__outline *s, const peri__piece *piece, double *vertices, int32_t *shares) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    for (int64_t i = piece->first; i < piece->first + piece->count; ++i) {
        const double edge = piece->lattice ? 0.0 : pow(m->volume[i], 1.0 / b->dim) * m->length;
        double corner[8][3], f[3][3];
        if (!peri__is_drawn(s, i)) continue;
        peri__turn_cell(s, i, f);
        if (piece->lattice) peri__cell_vertices(piece, b->dim, piece->vertices ? i - piece->first : peri__site_of(b, piece, i), corner);
        for (int32_t c = 0; c < s->corners; ++c) {
            const int32_t vertex = s->number[peri__whole_corner(s, i * s->corners + c)];
            double offset[3] = { 0.0, 0.0, 0.0 };
            if (vertex < 0) continue;
            for (int32_t d = 0; d < b->dim; ++d)
                offset[d] = piece->lattice ? (corner[c][d] - peri__in_cells(b, piece, i, d)) * piece->cell[d] : edge * ((c >> d & 1) - 0.5);
            for (int32_t e = 0; e < b->dim; ++e) {
                double place = peri__position(b, i, e) + peri__moved(b, i, e);
                for (int32_t d = 0; d < b->dim; ++d) place += f[d][e] * offset[d];
                vertices[(int64_t)vertex * b->dim + e] += place;
            }
            shares[vertex]++;
        }
    }
}

/* 0 where memory is short. */
static int peri__place_vertices(const peri__outline *s, double *vertices) {
    const peri_body *b = s->body;
    int32_t *shares = (int32_t *)peri__new(&b->scratch, s->vertices, sizeof *shares);
    int ok = shares != NULL;
    for (int64_t k = 0; ok && k < s->vertices * b->dim; ++k) vertices[k] = 0.0;
    for (int64_t p = 0; ok && p < b->model->piece_count; ++p) {
        peri__piece piece = b->model->pieces[p];
        if (piece.lattice && piece.amount > 0.0) ok = peri__move_vertices(&b->scratch, &piece, b->dim);
        if (ok) peri__add_corners(s, &piece, vertices, shares);
        peri__delete(&b->scratch, piece.vertices, piece.vertex_bytes, 1);
    }
    for (int64_t k = 0; ok && k < s->vertices * b->dim; ++k) vertices[k] /= shares[k / b->dim];
    peri__delete(&b->scratch, shares, s->vertices, sizeof *shares);
    return ok;
}

/* ---- calls -------------------------------------------------------------------------------------------------------- */

PERI_API int32_t peri_size_of_outline(peri_body *b, int32_t fragment, int64_t *vertices, int64_t *faces) {
    peri__outline s;
    PERI_NEED_BUILT(b);
    PERI_NEED(b, vertices, "vertices");
    PERI_NEED(b, faces, "faces");
    const int32_t status = peri__open_outline(b, fragment, &s);
    if (status < 0) return status;
    if (b->dim == 2) peri__follow_sides(&s, NULL);
    else peri__list_sides(&s, NULL);
    *vertices = s.vertices;
    *faces = s.faces;
    return peri__close_outline(&s, PERI_OK);
}

/* `side`: [faces] room, of which a plane uses all. */
static void peri__write_faces(const peri__outline *s, const int32_t *side, int32_t *faces, int32_t *owners, int32_t *inner) {
    const int32_t dim = s->body->dim;
    for (int64_t k = 0; k < s->faces; ++k) {
        const int32_t at = dim == 2 ? side[k] : side[k / 2], cell = at / s->sides, which = at % s->sides;
        for (int32_t d = 0; d < dim; ++d) {
            const int32_t c = dim == 2 ? peri__edge_corners[which][d] : peri__quad[which][d == 0 ? 0 : d + (int32_t)(k % 2)];
            faces[k * dim + d] = s->number[peri__whole_corner(s, (int64_t)cell * s->corners + c)];
        }
        if (owners) owners[k] = cell;
        if (inner) inner[k] = s->side[at] == PERI_CRACK;
    }
}

PERI_API int32_t peri_get_outline(peri_body *b, int32_t fragment, double *vertices, int64_t vertex_capacity, int32_t *faces,
                                  int32_t *owners, int32_t *inner, int64_t face_capacity) {
    peri__outline s;
    PERI_NEED_BUILT(b);
    PERI_NEED(b, vertices, "vertices");
    PERI_NEED(b, faces, "faces");
    int32_t status = peri__open_outline(b, fragment, &s);
    if (status < 0) return status;
    const int64_t sides = b->model->points * s.sides;
    int32_t *side = (int32_t *)peri__new_unset(&b->scratch, sides, sizeof *side);
    if (side) {
        if (b->dim == 2) peri__follow_sides(&s, side);
        else peri__list_sides(&s, side);
    }
    if (!side) status = peri__fail(b, PERI_ERROR_MEMORY, "fragment", -1, 0.0);
    else if (vertex_capacity < s.vertices) status = peri__fail(b, PERI_ERROR_CAPACITY, "vertex_capacity", -1, (double)s.vertices);
    else if (face_capacity < s.faces) status = peri__fail(b, PERI_ERROR_CAPACITY, "face_capacity", -1, (double)s.faces);
    else if (!peri__place_vertices(&s, vertices)) status = peri__fail(b, PERI_ERROR_MEMORY, "vertices", -1, 0.0);
    else peri__write_faces(&s, side, faces, owners, inner);
    peri__delete(&b->scratch, side, sides, sizeof *side);
    return peri__close_outline(&s, status);
}
