/* SPDX-License-Identifier: MIT */
/* partial_volumes.c - quadrature: which part beta of a neighbour's cell lies within the horizon. The rules of peri_quadrature. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* X(name, number, exact, planar). exact: beta is the part of the cell within the horizon; planar: the centroid of the part counts, too,
   which is known in the plane only. */
#define PERI_QUADRATURE_LIST(X)                                                                                        \
    X(FULL, 501, 0, 0)                                                                                            \
    X(RAMP, 502, 0, 0)                                                                                            \
    X(PARTIAL, 503, 1, 0)                                                                                         \
    X(PARTIAL_CENTROID, 504, 1, 1)                                                                                       \
    X(PARTIAL_MOMENT, 505, 1, 1)

#define PERI_QUADRATURE_NUMBER_(name, number, exact, planar) PERI_SAME_NUMBER_(QUADRATURE_##name, PERI_QUADRATURE_##name == (number))
PERI_QUADRATURE_LIST(PERI_QUADRATURE_NUMBER_)
PERI_SAME_COUNT(quadrature, PERI_QUADRATURE_LIST, peri__count_quadrature);

static int peri__is_exact(int32_t quadrature) {
#define PERI_EXACT_CASE_(name, number, exact, planar) || (quadrature == (number) && exact)
    return 0 PERI_QUADRATURE_LIST(PERI_EXACT_CASE_);
#undef PERI_EXACT_CASE_
}

static int peri__is_planar(int32_t quadrature) {
#define PERI_PLANAR_CASE_(name, number, exact, planar) || (quadrature == (number) && planar)
    return 0 PERI_QUADRATURE_LIST(PERI_PLANAR_CASE_);
#undef PERI_PLANAR_CASE_
}

/* Everything that building families and weights needs to know about the points; inner units. */
typedef struct peri__cloud {
    peri_body       *body;
    peri__model     *model;
    double          *x;        /* [points*dim]                                                                           */
    double           reach2;   /* square of the largest distance of a bond                                               */
    double           largest;  /* edge of the largest cell                                                               */
    double           edge;     /* of the cell of mean size: half of it over the horizon                                  */
    int64_t          cells[3]; /* the search grid                                                                        */
    double           lo[3], scale[3];
    int32_t         *start;    /* [cells+1] place of the first point of a cell                                           */
    int64_t          cell_count;
    int32_t         *order;    /* [points] ids by place; the model has taken it where NULL                               */
    int32_t         *cell;     /* [points] scratch of sorting                                                            */
    double          *placed;   /* [dim][points + PERI_NEAR_PIECE] x by place                                             */
    int32_t          isa;      /* see peri__isa                                                                          */
    int              weighs;   /* weights are made with the rows, see peri__write_families                                */
    double           even;     /* the volume of every point, or 0 where they differ                                      */
    double           gauss_x[PERI_GAUSS], gauss_w[PERI_GAUSS];
} peri__cloud;

/* Parts by bond vector, for one block of points: a lattice has few different ones. Direct-mapped. */
#define PERI_PART_SLOTS 256
typedef struct peri__partial_volumes {
    double             key[PERI_PART_SLOTS][3], part[PERI_PART_SLOTS];
    const peri__piece *piece[PERI_PART_SLOTS]; /* pieces differ in their cells; NULL: free                               */
} peri__partial_volumes;

static void peri__clear_partial_volumes(peri__partial_volumes *parts) { memset((void *)parts->piece, 0, sizeof parts->piece); }

static const peri__piece *peri__piece_of(const peri__cloud *c, int64_t i) {
    const peri__setup *s = &c->body->setup;
    int64_t lo = 0, hi = s->piece_count - 1;
    while (lo < hi) {
        int64_t mid = (lo + hi + 1) / 2;
        if (s->pieces[mid].first <= i) lo = mid;
        else hi = mid - 1;
    }
    return &s->pieces[lo];
}

/* Half the edges of cell i, taken as a box about the point. */
static void peri__half_cell(const peri__cloud *c, const peri__piece *piece, int64_t i, double *half) {
    const peri__model *m = c->model;
    for (int32_t d = 0; d < m->dim; ++d)
        half[d] = piece->lattice && !piece->vertices ? 0.5 * piece->cell[d] / m->length
                                                     : 0.5 * pow(m->volume[i], 1.0 / m->dim);
}

/* The corners of the moved cell j from point i, in VTK's order. */
static void peri__moved_corners(const peri__cloud *c, const peri__piece *piece, int64_t i, int64_t j, double out[8][3]) {
    static const int ring[8] = { 0, 1, 3, 2, 4, 5, 7, 6 };
    const peri__model *m = c->model;
    double corner[8][3];
    peri__cell_vertices(piece, m->dim, j - piece->first, corner);
    for (int k = 0; k < 1 << m->dim; ++k)
        for (int d = 0; d < m->dim; ++d)
            out[k][d] = (piece->origin[d] - m->origin[d]) / m->length
                      + corner[ring[k]][d] * (piece->cell[d] / m->length) - c->x[i * m->dim + d];
}

/* Part of the moved quadrilateral j, 2D. */
static double peri__moved_part(const peri__cloud *c, const peri__piece *piece, int64_t i, int64_t j, double *centroid) {
    double corner[8][3], polygon[4][2];
    peri__moved_corners(c, piece, i, j, corner);
    for (int k = 0; k < 4; ++k) memcpy(polygon[k], corner[k], sizeof polygon[k]);
    return peri__volume_of_overlap(peri__disk_polygon(c->model->horizon, polygon, 4), c->model->volume[j], centroid);
}

/* The square of what no corner of a moved cell is farther from its centroid: a whole cell per axis. */
static double peri__moved_size2(const peri__cloud *c, const peri__piece *piece) {
    double size2 = 0.0;
    for (int d = 0; d < 3; ++d) size2 += peri__square(piece->cell[d] / c->model->length);
    return size2;
}

/* How many corners of the moved hexahedron j at xi are within the horizon; -1: all of it is beyond. */
static int peri__moved_within(const peri__cloud *c, const peri__piece *piece, const double *xi, int64_t i, int64_t j, double corner[8][3]) {
    const double horizon = c->model->horizon;
    int within = 0;
    if (peri__dot(xi, xi, 3) > peri__square(horizon + sqrt(peri__moved_size2(c, piece)))) return -1;
    peri__moved_corners(c, piece, i, j, corner);
    for (int k = 0; k < 8; ++k) within += peri__dot(corner[k], corner[k], 3) < horizon * horizon * (1.0 - PERI_HORIZON_TOLERANCE);
    return within;
}

static double peri__moved_volume(const peri__cloud *c, const peri__piece *piece, const double *xi, int64_t i, int64_t j) {
    double corner[8][3];
    const int within = peri__moved_within(c, piece, xi, i, j, corner), amid = peri__dot(xi, xi, 3) < peri__moved_size2(c, piece);
    if (within < 0 || within == 8) return within < 0 ? 0.0 : 1.0;
    return peri__ball_cell(c->model->horizon, corner, 8, amid) / c->model->volume[j];
}

/* Squares of the distances from a point to the nearest and the farthest place of a box at xi with the given half edges. */
static void peri__box_distances(const double *xi, const double *half, int32_t dim, double *near2, double *far2) {
    *near2 = *far2 = 0.0;
    for (int32_t d = 0; d < dim; ++d) {
        double a = fabs(xi[d]);
        if (a > half[d]) *near2 += peri__square(a - half[d]);
        *far2 += peri__square(a + half[d]);
    }
}

/* Part of cell j within the horizon of i, in [0, 1], and (2D, where asked) the centroid of that part less x_i; of the whole cell where
   there is no part. */
static double peri__partial_volume(const peri__cloud *c, int64_t i, int64_t j, double *centroid) {
    const peri__model *m = c->model;
    const peri__piece *piece = peri__piece_of(c, j);
    double xi[3] = { 0.0, 0.0, 0.0 }, half[3] = { 0.0, 0.0, 0.0 }, near2, far2, part;
    for (int32_t d = 0; d < m->dim; ++d) xi[d] = c->x[j * m->dim + d] - c->x[i * m->dim + d];
    if (centroid) memcpy(centroid, xi, (size_t)m->dim * sizeof(double));
    if (piece->shapes) {
        part = peri__part_of_shape(m, piece, xi, j, centroid);
    } else if (piece->vertices) {
        part = m->dim == 2 ? peri__moved_part(c, piece, i, j, centroid) : peri__moved_volume(c, piece, xi, i, j);
    } else {
        peri__half_cell(c, piece, j, half);
        peri__box_distances(xi, half, m->dim, &near2, &far2);
        if (far2 <= m->horizon * m->horizon) return 1.0;
        if (near2 >= m->horizon * m->horizon) return 0.0;
        if (m->dim == 3) {
            part = peri__ball_box(m->horizon, xi, half, c->gauss_x, c->gauss_w) / (8.0 * half[0] * half[1] * half[2]);
        } else {
            part = peri__volume_of_overlap(peri__disk_rectangle(m->horizon, xi, half[0], half[1]), 4.0 * half[0] * half[1], centroid);
        }
    }
    return part > 1.0 ? 1.0 : part;
}

/* [T] Fig. 3.7: 1 up to h - spacing/2, then linear to 0 at h + spacing/2; spacing is the mean of both cells'. */
static double peri__ramp(const peri__cloud *c, int64_t i, int64_t j) {
    const peri__model *m = c->model;
    double square = 0.0, spacing = 0.5 * (pow(m->volume[i], 1.0 / m->dim) + pow(m->volume[j], 1.0 / m->dim));
    for (int32_t d = 0; d < m->dim; ++d) square += peri__square(c->x[j * m->dim + d] - c->x[i * m->dim + d]);
    double part = (m->horizon + 0.5 * spacing - sqrt(square)) / spacing;
    return part > 1.0 ? 1.0 : part > 0.0 ? part : 0.0;
}

/* beta of bond (i,j): the mean of both directions, so that V_i beta V_j is the same from both ends and momentum is conserved. */
static double peri__beta(const peri__cloud *c, peri__partial_volumes *parts, int64_t i, int64_t j) {
    const peri__model *m = c->model;
    const peri__piece *pi = peri__piece_of(c, i);
    double part, xi[3] = { 0.0, 0.0, 0.0 };
    int regular = pi->lattice && !pi->vertices && j >= pi->first && j < pi->first + pi->count;
    size_t slot = 0;
    if (c->body->desc.quadrature == PERI_QUADRATURE_FULL) return 1.0;
    if (c->body->desc.quadrature == PERI_QUADRATURE_RAMP) return peri__ramp(c, i, j);
    for (int32_t d = 0; d < m->dim; ++d) regular = regular && fabs(c->x[j * m->dim + d] - c->x[i * m->dim + d]) < 1e5;
    if (!regular) {
        part = 0.5 * (peri__partial_volume(c, i, j, NULL) + peri__partial_volume(c, j, i, NULL));
        return part > PERI_NO_PART ? part : 0.0;
    }
    uint64_t hash = 0;
    for (int32_t d = 0; d < m->dim; ++d) { /* the cell is symmetric, so signs do not matter; 2^-44 is below any kink of beta */
        xi[d] = floor(fabs(c->x[j * m->dim + d] - c->x[i * m->dim + d]) * 17592186044416.0 + 0.5);
        hash = (hash ^ (uint64_t)xi[d]) * UINT64_C(0x9E3779B97F4A7C15);
    }
    slot = (size_t)(hash >> 56) % PERI_PART_SLOTS;
    if (parts->piece[slot] != pi || memcmp(parts->key[slot], xi, sizeof xi) != 0) {
        part = peri__partial_volume(c, i, j, NULL);
        parts->part[slot] = part > PERI_NO_PART ? part : 0.0;
        parts->piece[slot] = pi;
        memcpy(parts->key[slot], xi, sizeof xi);
    }
    return parts->part[slot];
}

/* How far apart points can be that share a bond. */
static void peri__set_reach(peri__cloud *c) {
    const peri__model *m = c->model;
    double reach = m->horizon * (1.0 + PERI_HORIZON_TOLERANCE);
    if (c->body->desc.quadrature == PERI_QUADRATURE_RAMP) reach += 0.5 * c->largest;
    if (peri__is_exact(c->body->desc.quadrature)) reach += c->largest * sqrt((double)m->dim); /* moved cells are longer */
    for (int64_t p = 0; p < c->body->setup.piece_count; ++p) {
        const peri__cells *shapes = c->body->setup.pieces[p].shapes;
        if (shapes) reach = fmax(reach, m->horizon * (1.0 + PERI_HORIZON_TOLERANCE) + shapes->radius / m->length);
    }
    c->reach2 = reach * reach;
}

/* Is any part of cell j within the horizon of i? Cheap for boxes: in 3D the part itself is an integral. */
static int peri__has_part(const peri__cloud *c, int64_t i, int64_t j) {
    const peri__model *m = c->model;
    const peri__piece *piece = peri__piece_of(c, j);
    double xi[3] = { 0.0, 0.0, 0.0 }, half[3] = { 0.0, 0.0, 0.0 }, corner[8][3], near2, far2;
    for (int32_t d = 0; d < m->dim; ++d) xi[d] = c->x[j * m->dim + d] - c->x[i * m->dim + d];
    if (piece->vertices && m->dim == 3 && peri__moved_within(c, piece, xi, i, j, corner) > 0) return 1;
    if (piece->vertices) return peri__partial_volume(c, i, j, NULL) > PERI_NO_PART;
    if (piece->shapes) return peri__reaches_shape(m, piece, xi, j);
    peri__half_cell(c, piece, j, half);
    peri__box_distances(xi, half, m->dim, &near2, &far2);
    return near2 < m->horizon * m->horizon * (1.0 - PERI_HORIZON_TOLERANCE);
}

/* Is j in the family of i, given that it is within reach? Mutual. */
static int peri__is_family(const peri__cloud *c, int64_t i, int64_t j) {
    switch (c->body->desc.quadrature) {
    case PERI_QUADRATURE_FULL: return 1;
    case PERI_QUADRATURE_RAMP: return peri__ramp(c, i, j) > PERI_HORIZON_TOLERANCE;
    default: return peri__has_part(c, i, j) || peri__has_part(c, j, i);
    }
}
