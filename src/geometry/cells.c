/* SPDX-License-Identifier: MIT */
/* cells.c - cells of the caller: polygons in planes; tetrahedra, pyramids, wedges and hexahedra in 3D. Their points, their volumes, and the
   part of one within a horizon.

   A face of four corners is four triangles about the mean of its corners: it looks the same from the cells on both sides, so that cells
   of a mesh leave no gap, and encloses the volume that the trilinear hexahedron has.

   Of a solid cell all triangles, seen from its centroid, must look away and surround it once: then it does not cross itself. Polygons may
   be of any form whose sides do not meet. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_CELLS (UINT64_C(0x70657269002A0000) + sizeof(peri_cells_desc))
#define PERI_HOLLOW       1e-12 /* of the cube, or square, of the extent: the volume of a cell that has none               */

PERI_API void peri_cells_desc_init(peri_cells_desc *d) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_CELLS;
}

/* ---- solid cells -------------------------------------------------------------------------------------------------- */

/* The faces of cells with 4, 5, 6 and 8 corners, outwards; -1: of three corners. */
static const int8_t peri__cell_faces[4][6][4] = {
    { { 0, 2, 1, -1 }, { 0, 1, 3, -1 }, { 1, 2, 3, -1 }, { 0, 3, 2, -1 } },
    { { 0, 3, 2, 1 }, { 0, 1, 4, -1 }, { 1, 2, 4, -1 }, { 2, 3, 4, -1 }, { 3, 0, 4, -1 } },
    { { 0, 2, 1, -1 }, { 3, 4, 5, -1 }, { 0, 1, 4, 3 }, { 1, 2, 5, 4 }, { 2, 0, 3, 5 } },
    { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 } }
};

static const int8_t (*peri__faces_of(int corners, int *faces))[4] {
    *faces = corners == 4 ? 4 : corners == 8 ? 6 : 5;
    return peri__cell_faces[corners == 8 ? 3 : corners - 4];
}

/* The corners of a face; returns how many. */
static int peri__face_corners(double x[][3], const int8_t *face, double out[4][3]) {
    const int sides = face[3] < 0 ? 3 : 4;
    for (int k = 0; k < sides; ++k) memcpy(out[k], x[face[k]], sizeof out[k]);
    return sides;
}

/* The triangles of a face; returns how many. */
static int peri__face_triangles(double x[][3], int sides, double out[4][3][3]) {
    double middle[3];
    if (sides == 3) {
        memcpy(out[0], x, sizeof out[0]);
        return 1;
    }
    for (int d = 0; d < 3; ++d) middle[d] = 0.25 * (x[0][d] + x[1][d] + x[2][d] + x[3][d]);
    for (int k = 0; k < 4; ++k) {
        memcpy(out[k][0], x[k], sizeof middle);
        memcpy(out[k][1], x[(k + 1) % 4], sizeof middle);
        memcpy(out[k][2], middle, sizeof middle);
    }
    return 4;
}

/* All triangles of a cell; returns how many. */
static int peri__cell_triangles(double x[][3], int corners, double out[24][3][3]) {
    int faces, count = 0;
    const int8_t (*face)[4] = peri__faces_of(corners, &faces);
    for (int f = 0; f < faces; ++f) {
        double side[4][3];
        const int sides = peri__face_corners(x, face[f], side);
        count += peri__face_triangles(side, sides, &out[count]);
    }
    return count;
}

/* Six times the volume between the origin and a triangle. */
static double peri__triple(double x[3][3]) {
    double cross[3];
    peri__cross(x[0], x[1], cross);
    return peri__dot(cross, x[2], 3);
}

/* Volume and centroid, from the origin. */
static double peri__solid_volume(double x[][3], int corners, double *centroid) {
    double triangle[24][3][3], volume = 0.0, moment[3] = { 0.0, 0.0, 0.0 };
    const int count = peri__cell_triangles(x, corners, triangle);
    for (int t = 0; t < count; ++t) {
        const double part = peri__triple(triangle[t]) / 6.0;
        volume += part;
        for (int d = 0; d < 3; ++d) moment[d] += 0.25 * part * (triangle[t][0][d] + triangle[t][1][d] + triangle[t][2][d]);
    }
    for (int d = 0; d < 3; ++d) centroid[d] = moment[d] / volume;
    return volume;
}

/* Is the cell, about its centroid as the origin, sound? The angles of a surface around the origin add up to 4 pi, signs included: where
   those of the triangles that look away do so alone, none looks inwards. */
static int peri__is_star(double x[][3], int corners, double volume) {
    double triangle[24][3][3], around = 0.0;
    const int count = peri__cell_triangles(x, corners, triangle);
    for (int t = 0; t < count; ++t)
        if (peri__triple(triangle[t]) > 6.0 * PERI_HOLLOW * volume) around += peri__solid_angle(triangle[t]);
    return fabs(around - 4.0 * PERI_PI) < 1e-9;
}

/* Mirrors the order of the corners. */
static void peri__mirror_cell(double x[][3], int corners) {
    const int apart = corners == 8 ? 4 : corners == 6 ? 3 : corners == 5 ? 2 : 1;
    for (int k = corners > 5 ? 0 : 1; k < (corners > 5 ? apart : 2); ++k)
        for (int d = 0; d < 3; ++d) {
            const double other = x[k][d];
            x[k][d] = x[k + apart][d];
            x[k + apart][d] = other;
        }
}

/* The volume within the ball about the origin, which is outside the cell unless `amid`. */
static double peri__ball_cell(double radius, double x[][3], int corners, int amid) {
    int faces;
    const int8_t (*face)[4] = peri__faces_of(corners, &faces);
    double volume = 0.0, around = 0.0;
    for (int f = 0; f < faces; ++f) {
        double side[4][3], triangle[4][3][3], edge[3][3], widest = 0.0;
        const int sides = peri__face_corners(x, face[f], side), count = peri__face_triangles(side, sides, triangle);
        for (int t = 0; amid && t < count; ++t) around += peri__solid_angle(triangle[t]);
        for (int k = 1; k < sides; ++k)
            for (int d = 0; d < 3; ++d) {
                edge[k - 1][d] = side[k][d] - side[0][d];
                widest = fmax(widest, fabs(edge[k - 1][d]));
            }
        if (sides == 3 || fabs(peri__triple(edge)) <= 1e-14 * widest * widest * widest) {
            volume += peri__ball_face(radius, side, sides);
            continue;
        }
        for (int t = 0; t < count; ++t) volume += peri__ball_face(radius, triangle[t], 3);
    }
    return volume + radius * radius * radius / 3.0 * (around > 2.0 * PERI_PI ? 4.0 * PERI_PI : 0.0);
}

/* ---- polygons ------------------------------------------------------------------------------------------------------- */

static double peri__polygon_area(double x[][2], int corners, double *centroid) {
    double twice = 0.0, moment[2] = { 0.0, 0.0 };
    for (int k = 0; k < corners; ++k) {
        const double *a = x[k], *b = x[(k + 1) % corners], cross = a[0] * b[1] - a[1] * b[0];
        twice += cross;
        for (int d = 0; d < 2; ++d) moment[d] += cross * (a[d] + b[d]) / 3.0;
    }
    for (int d = 0; d < 2; ++d) centroid[d] = moment[d] / twice;
    return 0.5 * twice;
}

static double peri__side_of(const double *a, const double *b, const double *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Have the segments a-b and c-d a place in common? */
static int peri__segments_meet(const double *a, const double *b, const double *c, const double *d) {
    const double ac = peri__side_of(a, b, c), ad = peri__side_of(a, b, d), ca = peri__side_of(c, d, a), cb = peri__side_of(c, d, b);
    if ((ac > 0.0 && ad > 0.0) || (ac < 0.0 && ad < 0.0) || (ca > 0.0 && cb > 0.0) || (ca < 0.0 && cb < 0.0)) return 0;
    for (int e = 0; e < 2; ++e) /* where all are on one line */
        if (fmin(a[e], b[e]) > fmax(c[e], d[e]) || fmin(c[e], d[e]) > fmax(a[e], b[e])) return 0;
    return 1;
}

/* Do no sides meet but in the corner between them? A side that goes back along the last one meets the one before that. */
static int peri__is_simple(double x[][2], int corners) {
    for (int k = 0; k < corners; ++k)
        for (int n = k + 2; n < corners - (k == 0); ++n)
            if (peri__segments_meet(x[k], x[k + 1], x[n], x[(n + 1) % corners])) return 0;
    return 1;
}

/* ---- a cell of a call ------------------------------------------------------------------------------------------------ */

typedef struct peri__cell { /* of either dimension                                                                        */
    int    corners;
    double volume, place[3], radius; /* radius: the largest distance of a corner from the place                           */
    double x[8][3], p[PERI_CORNERS][2]; /* from the place                                                                 */
} peri__cell;

/* Sets volume, place and order of a cell of which the corners are given from one of them; 0 where it is unsound. */
static int peri__measure_polygon(peri__cell *cell) {
    double widest = 0.0;
    for (int k = 0; k < cell->corners; ++k) widest = fmax(widest, fmax(fabs(cell->p[k][0]), fabs(cell->p[k][1])));
    cell->volume = cell->corners < 3 ? 0.0 : peri__polygon_area(cell->p, cell->corners, cell->place);
    if (!(fabs(cell->volume) > PERI_HOLLOW * widest * widest) || !peri__is_simple(cell->p, cell->corners)) return 0;
    for (int k = 0; cell->volume < 0.0 && k < cell->corners / 2; ++k)
        for (int d = 0; d < 2; ++d) {
            const double other = cell->p[k][d];
            cell->p[k][d] = cell->p[cell->corners - 1 - k][d];
            cell->p[cell->corners - 1 - k][d] = other;
        }
    cell->volume = fabs(cell->volume);
    for (int k = 0; k < cell->corners; ++k)
        for (int d = 0; d < 2; ++d) cell->p[k][d] -= cell->place[d];
    for (int k = 0; k < cell->corners; ++k) cell->radius = fmax(cell->radius, sqrt(peri__dot(cell->p[k], cell->p[k], 2)));
    return 1;
}

static int peri__measure_solid(peri__cell *cell) {
    double widest = 0.0;
    for (int k = 0; k < cell->corners; ++k)
        for (int d = 0; d < 3; ++d) widest = fmax(widest, fabs(cell->x[k][d]));
    cell->volume = peri__solid_volume(cell->x, cell->corners, cell->place);
    if (!(fabs(cell->volume) > PERI_HOLLOW * widest * widest * widest)) return 0;
    if (cell->volume < 0.0) peri__mirror_cell(cell->x, cell->corners);
    cell->volume = fabs(cell->volume);
    for (int k = 0; k < cell->corners; ++k)
        for (int d = 0; d < 3; ++d) cell->x[k][d] -= cell->place[d];
    for (int k = 0; k < cell->corners; ++k) cell->radius = fmax(cell->radius, sqrt(peri__dot(cell->x[k], cell->x[k], 3)));
    return peri__is_star(cell->x, cell->corners, cell->volume);
}

/* Reads cell k. Of corners of a polygon that follow each other at the same place one counts. */
static int32_t peri__read_cell(peri_body *b, const peri_cells_desc *d, int64_t k, int64_t total, peri__cell *cell) {
    const int64_t begin = d->offsets ? d->offsets[k] : k * d->cell_corners, end = d->offsets ? d->offsets[k + 1] : begin + d->cell_corners;
    const int64_t stride = d->vertex_stride ? d->vertex_stride : b->dim, corners = end - begin;
    const double *from = NULL, *last = NULL;
    const int known = b->dim == 2 ? corners >= 3 && corners <= PERI_CORNERS : corners == 8 || (corners >= 4 && corners <= 6);
    if (begin < 0 || end > total || !known)
        return peri__fail(b, PERI_ERROR_RANGE, d->offsets ? "offsets" : "cell_corners", k, (double)corners);
    cell->corners = 0;
    cell->radius = 0.0;
    for (int64_t n = begin; n < end; ++n) {
        const int64_t v = d->corners[n];
        if (v < 0 || v >= d->vertex_count) return peri__fail(b, PERI_ERROR_INDEX, "corners", k, (double)v);
        const double *x = &d->vertices[v * stride];
        if (!peri__finite_vector(x, b->dim)) return peri__fail(b, PERI_ERROR_POINT, "vertices", v, peri__not_finite(x, b->dim));
        if (!from) from = x;
        if (b->dim == 2 && last && x[0] == last[0] && x[1] == last[1]) continue;
        last = x;
        for (int32_t a = 0; a < b->dim; ++a) *(b->dim == 2 ? &cell->p[cell->corners][a] : &cell->x[cell->corners][a]) = x[a] - from[a];
        cell->corners++;
    }
    if (b->dim == 2 && cell->corners > 1 && last[0] == from[0] && last[1] == from[1]) cell->corners--;
    const int sound = b->dim == 2 ? peri__measure_polygon(cell) : peri__measure_solid(cell);
    for (int32_t a = 0; a < b->dim; ++a) cell->place[a] += from[a];
    if (!sound || !peri__finite_vector(cell->place, b->dim) || !peri__finite(cell->volume))
        return peri__fail(b, PERI_ERROR_POINT, "corners", k, cell->volume);
    return PERI_OK;
}

static peri__cells *peri__new_shapes(const peri__memory *memory, int64_t cells, int64_t corners, int32_t dim) {
    const int64_t bytes = (int64_t)sizeof(peri__cells) + (cells + 1) * (int64_t)sizeof(int64_t) + corners * dim * (int64_t)sizeof(double);
    peri__cells *made = (peri__cells *)peri__new(memory, bytes, 1);
    if (!made) return NULL;
    made->bytes = bytes;
    made->first = (int64_t *)(void *)(made + 1);
    made->corner = (double *)(void *)(made->first + cells + 1);
    return made;
}

/* Fills the points after the last one, and `shapes` where they are kept. */
static int32_t peri__read_cells(peri_body *b, const peri_cells_desc *d, int64_t total, peri__cells *shapes) {
    peri__setup *s = &b->setup;
    peri__cell cell;
    for (int64_t k = 0; k < d->cell_count; ++k) {
        const int64_t point = s->point_count + k, at = d->materials ? peri__find(b, PERI_KIND_MATERIAL, d->materials[k], "materials") : 0;
        if (at < 0) return peri__fail(b, (int32_t)at, "materials", k, d->materials[k]);
        const int32_t status = peri__read_cell(b, d, k, total, &cell);
        if (status < 0) return status;
        memcpy(&s->local[point * b->dim], cell.place, (size_t)b->dim * sizeof(double));
        s->volume[point] = cell.volume;
        s->material[point] = (uint8_t)(d->materials ? PERI_ID_INDEX(d->materials[k]) - 1 : 0);
        if (!shapes) continue;
        const void *corners = b->dim == 2 ? (const void *)cell.p : (const void *)cell.x;
        memcpy(&shapes->corner[shapes->first[k] * b->dim], corners, (size_t)(cell.corners * b->dim) * sizeof(double));
        shapes->first[k + 1] = shapes->first[k] + cell.corners;
        shapes->radius = fmax(shapes->radius, cell.radius);
    }
    return PERI_OK;
}

static int peri__is_exact(int32_t quadrature);

PERI_API int64_t peri_add_cells(peri_body *b, const peri_cells_desc *desc) {
    PERI_NEED_UNBUILT(b);
    PERI_NEED(b, desc, "desc");
    if (desc->cookie != PERI_COOKIE_CELLS) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED(b, desc->cell_count >= 0, "cell_count");
    if (desc->cell_count == 0) return peri__fail(b, PERI_ERROR_EMPTY, "cell_count", -1, 0.0);
    PERI_NEED(b, desc->vertices && desc->vertex_count > 0, "vertices");
    PERI_NEED(b, desc->corners, "corners");
    PERI_NEED(b, desc->vertex_stride == 0 || desc->vertex_stride >= b->dim, "vertex_stride");
    if (!desc->materials && b->material_count != 1)
        return peri__fail(b, b->material_count ? PERI_ERROR_ID_NONE : PERI_ERROR_MATERIAL, "materials", -1, b->material_count);
    peri__setup *s = &b->setup;
    if (desc->cell_count > PERI_POINT_LIMIT - s->point_count)
        return peri__fail(b, PERI_ERROR_TOO_LARGE, "cell_count", -1, (double)desc->cell_count); /* not read */
    if (!desc->offsets) PERI_NEED(b, desc->cell_corners > 0 && desc->cell_corners <= PERI_CORNERS, "cell_corners");
    const int64_t total = desc->offsets ? desc->offsets[desc->cell_count] : desc->cell_count * desc->cell_corners;
    if (total < 0 || total > desc->cell_count * PERI_CORNERS)
        return peri__fail(b, PERI_ERROR_RANGE, "offsets", desc->cell_count, (double)total);
    peri__cells *shapes = NULL;
    int32_t status = peri__reserve_points(b, desc->cell_count);
    if (status == PERI_OK && peri__is_exact(b->desc.quadrature)) {
        shapes = peri__new_shapes(&b->memory, desc->cell_count, total, b->dim);
        if (!shapes) status = peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
    }
    if (status == PERI_OK) status = peri__read_cells(b, desc, total, shapes);
    if (status < 0) {
        peri__delete(&b->memory, shapes, shapes ? shapes->bytes : 0, 1);
        return status;
    }
    peri__piece *piece = &s->pieces[s->piece_count++];
    memset(piece, 0, sizeof *piece);
    piece->first = s->point_count;
    piece->count = desc->cell_count;
    piece->shapes = shapes;
    s->point_count += desc->cell_count;
    return desc->cell_count;
}

/* ---- the part within a horizon ----------------------------------------------------------------------------------------- */

/* The corners of cell j of a piece from the point that it is xi from, inner units, to `solid` or `flat`. Returns how many; *within: how
   many of these are within the horizon. */
static int peri__shape_corners(const peri__model *m, const peri__piece *piece, const double *xi, int64_t j, double solid[8][3],
                               double flat[PERI_CORNERS][2], int *within) {
    const peri__cells *shapes = piece->shapes;
    const int64_t first = shapes->first[j - piece->first];
    const int corners = (int)(shapes->first[j - piece->first + 1] - first);
    *within = 0;
    for (int k = 0; k < corners; ++k) {
        double *x = m->dim == 2 ? flat[k] : solid[k];
        for (int32_t d = 0; d < m->dim; ++d) x[d] = xi[d] + shapes->corner[(first + k) * m->dim + d] / m->length;
        *within += peri__dot(x, x, m->dim) < m->horizon * m->horizon * (1.0 - PERI_HORIZON_TOLERANCE);
    }
    return corners;
}

static int peri__is_beyond(const peri__model *m, const peri__piece *piece, const double *xi) {
    return peri__dot(xi, xi, m->dim) > peri__square(m->horizon + piece->shapes->radius / m->length);
}

/* Part of cell j at xi within the horizon, and (2D, where asked) its centroid, which is not set where there is none or all is. */
static double peri__part_of_shape(const peri__model *m, const peri__piece *piece, const double *xi, int64_t j, double *centroid) {
    double solid[8][3], flat[PERI_CORNERS][2];
    int within;
    if (peri__is_beyond(m, piece, xi)) return 0.0;
    const int corners = peri__shape_corners(m, piece, xi, j, solid, flat, &within);
    if (within == corners) return 1.0;
    if (m->dim == 2) return peri__volume_of_overlap(peri__disk_polygon(m->horizon, flat, corners), m->volume[j], centroid);
    const int amid = peri__dot(xi, xi, 3) < peri__square(piece->shapes->radius / m->length);
    return peri__ball_cell(m->horizon, solid, corners, amid) / m->volume[j];
}

/* Is any part of cell j at xi within the horizon? */
static int peri__reaches_shape(const peri__model *m, const peri__piece *piece, const double *xi, int64_t j) {
    double solid[8][3], flat[PERI_CORNERS][2];
    int within;
    if (peri__is_beyond(m, piece, xi)) return 0;
    (void)peri__shape_corners(m, piece, xi, j, solid, flat, &within);
    return within > 0 || peri__part_of_shape(m, piece, xi, j, NULL) > PERI_NO_PART;
}
