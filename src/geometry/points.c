/* SPDX-License-Identifier: MIT */
/* points.c - boxes, balls, shapes and arrays to points, volumes and cells. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_POINT_LIMIT (INT32_MAX - PERI_BLOCK) /* ids are int32                                                       */

/* Room for `count` more points and one more piece. */
static int32_t peri__reserve_points(peri_body *b, int64_t count) {
    peri__setup *s = &b->setup;
    int64_t capacity = s->point_capacity, need;
    if (count > PERI_POINT_LIMIT - s->point_count) return peri__fail(b, PERI_ERROR_TOO_LARGE, "points", -1, (double)count);
    if (!peri__grow(&b->memory, &s->pieces, &s->piece_capacity, s->piece_count + 1, sizeof *s->pieces))
        return peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
    need = s->point_count + count;
    if (need > capacity) {
        /* three arrays grow together: all of them or none */
        int64_t room = need > 2 * capacity ? need : 2 * capacity;
        double *local = (double *)peri__new(&b->memory, room * b->dim, sizeof(double));
        double *volume = (double *)peri__new(&b->memory, room, sizeof(double));
        uint8_t *material = (uint8_t *)peri__new(&b->memory, room, 1);
        if (!local || !volume || !material) {
            peri__delete(&b->memory, local, room * b->dim, sizeof(double));
            peri__delete(&b->memory, volume, room, sizeof(double));
            peri__delete(&b->memory, material, room, 1);
            return peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
        }
        if (s->point_count > 0) {
            memcpy(local, s->local, (size_t)(s->point_count * b->dim) * sizeof(double));
            memcpy(volume, s->volume, (size_t)s->point_count * sizeof(double));
            memcpy(material, s->material, (size_t)s->point_count);
        }
        peri__delete(&b->memory, s->local, capacity * b->dim, sizeof(double));
        peri__delete(&b->memory, s->volume, capacity, sizeof(double));
        peri__delete(&b->memory, s->material, capacity, 1);
        s->local = local;
        s->volume = volume;
        s->material = material;
        s->point_capacity = room;
    }
    return PERI_OK;
}

static void peri__free_setup(peri_body *b) {
    peri__setup *s = &b->setup;
    for (int64_t k = 0; k < s->piece_count; ++k) {
        peri__delete(&b->memory, s->pieces[k].vertices, s->pieces[k].vertex_bytes, 1);
        peri__delete(&b->memory, s->pieces[k].shapes, s->pieces[k].shapes ? s->pieces[k].shapes->bytes : 0, 1);
    }
    peri__delete(&b->memory, s->pieces, s->piece_capacity, sizeof *s->pieces);
    peri__delete(&b->memory, s->local, s->point_capacity * b->dim, sizeof(double));
    peri__delete(&b->memory, s->volume, s->point_capacity, sizeof(double));
    peri__delete(&b->memory, s->material, s->point_capacity, 1);
    peri__delete(&b->memory, s->ibond, s->ibond_entries, sizeof(int32_t));
    peri__delete(&b->memory, s->part, s->part ? s->part->bytes : 0, 1);
    memset(s, 0, sizeof *s);
}

/* Checks a box and lays cells in it: cells[dim] per axis, or where that is NULL of about `spacing`. */
static int32_t peri__tile(peri_body *b, int32_t material, const double *lo, const double *hi, double spacing, const int32_t *cells,
                          peri__piece *piece) {
    PERI_NEED_UNBUILT(b);
    const int64_t at = peri__find(b, PERI_KIND_MATERIAL, material, "material");
    double sites = 1.0;
    if (at < 0) return (int32_t)at;
    PERI_NEED_VECTOR(b, lo);
    PERI_NEED_VECTOR(b, hi);
    if (!cells) PERI_NEED_NUMBER(b, spacing > 0.0, spacing);
    memset(piece, 0, sizeof *piece);
    piece->first = b->setup.point_count;
    piece->lattice = 1;
    for (int32_t d = 0; d < b->dim; ++d) {
        double count = cells ? cells[d] : floor((hi[d] - lo[d]) / spacing + 0.5);
        if (!(hi[d] > lo[d]) || !peri__finite(hi[d] - lo[d]))
            return peri__fail(b, PERI_ERROR_RANGE, "hi", d, hi[d] - lo[d]);
        if (cells && count < 1.0) return peri__fail(b, PERI_ERROR_RANGE, "cells", d, count);
        if (count < 1.0) count = 1.0;
        sites *= count;
        if (sites > (double)PERI_POINT_LIMIT) return peri__fail(b, PERI_ERROR_TOO_LARGE, cells ? "cells" : "spacing", -1, sites);
        piece->cells[d] = (int64_t)count;
        piece->origin[d] = lo[d];
        piece->cell[d] = (hi[d] - lo[d]) / count;
    }
    return PERI_OK;
}

static int32_t peri__lattice(peri_body *b, int32_t material, const double *lo, const double *hi, double spacing, peri__piece *piece) {
    return peri__tile(b, material, lo, hi, spacing, NULL, piece);
}

typedef struct peri__within { /* predicate of a ball                                                                      */
    const double *centre;
    double        radius;
    int32_t       dim;
} peri__within;

static int32_t peri__is_within(void *user, int64_t index, const double *x) {
    const peri__within *ball = (const peri__within *)user;
    double square = 0.0;
    (void)index;
    for (int32_t d = 0; d < ball->dim; ++d) square += peri__square(x[d] - ball->centre[d]);
    return square <= peri__square(ball->radius);
}

/* Indices of site k, x fastest. */
static void peri__site(const peri__piece *piece, int64_t k, int64_t *index) {
    index[0] = k % piece->cells[0];
    index[1] = k / piece->cells[0] % piece->cells[1];
    index[2] = k / piece->cells[0] / piece->cells[1];
}

/* Marks the sites that `inside` takes, one bit each, and counts them. It sees every site once, in order, until it fails. */
static int64_t peri__mark_sites(peri_body *b, const peri__piece *piece, int64_t sites, peri_point_fn inside, void *user,
                                uint8_t *taken) {
    int64_t count = 0;
    int32_t said = 0;
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    for (int64_t k = 0; k < sites && said >= 0; ++k) {
        int64_t index[3];
        double x[3];
        peri__site(piece, k, index);
        for (int32_t d = 0; d < b->dim; ++d) x[d] = piece->origin[d] + ((double)index[d] + 0.5) * piece->cell[d];
        said = inside(user, k, x);
        if (said <= 0) continue;
        taken[k / 8] = (uint8_t)(taken[k / 8] | 1 << k % 8);
        count++;
    }
    peri__leave(b, former);
    return said < 0 ? peri__fail(b, PERI_ERROR_CALLBACK, "peri_point_fn", -1, said) : count;
}

/* Adds the sites of a lattice that `inside` takes (all where it is NULL). */
static int64_t peri__add_lattice(peri_body *b, int32_t material, peri__piece *piece, peri_point_fn inside, void *user) {
    peri__setup *s = &b->setup;
    int64_t sites = piece->cells[0] * piece->cells[1] * (b->dim == 3 ? piece->cells[2] : 1), added = sites;
    double cell_volume = piece->cell[0] * piece->cell[1] * (b->dim == 3 ? piece->cell[2] : 1.0);
    uint8_t *taken = NULL;
    int32_t status = PERI_OK;
    if (!(cell_volume > 0.0 && peri__finite(cell_volume)))
        return peri__fail(b, PERI_ERROR_RANGE, "spacing", -1, cell_volume);
    if (inside) {
        taken = (uint8_t *)peri__new(&b->scratch, sites / 8 + 1, 1);
        if (!taken) return peri__fail(b, PERI_ERROR_MEMORY, "peri_add_shape", -1, 0.0);
        added = peri__mark_sites(b, piece, sites, inside, user, taken);
        if (added < 0) status = (int32_t)added;
        if (added == 0) status = peri__fail(b, PERI_ERROR_EMPTY, "peri_add_shape", -1, 0.0);
    }
    if (status == PERI_OK) status = peri__reserve_points(b, added);
    for (int64_t k = 0, point = s->point_count; status == PERI_OK && k < sites; ++k) {
        int64_t index[3];
        if (taken && !(taken[k / 8] >> k % 8 & 1)) continue;
        peri__site(piece, k, index);
        for (int32_t d = 0; d < b->dim; ++d) s->local[point * b->dim + d] = (double)index[d] + 0.5;
        s->volume[point] = cell_volume;
        s->material[point] = (uint8_t)(PERI_ID_INDEX(material) - 1);
        point++;
    }
    peri__delete(&b->scratch, taken, sites / 8 + 1, 1);
    if (status < 0) return status;
    piece->count = added;
    s->pieces[s->piece_count++] = *piece;
    s->point_count += added;
    return added;
}

PERI_API int64_t peri_add_box(peri_body *b, int32_t material, const double *lo, const double *hi, double spacing) {
    peri__piece piece;
    int32_t status = peri__lattice(b, material, lo, hi, spacing, &piece);
    return status < 0 ? status : peri__add_lattice(b, material, &piece, NULL, NULL);
}

PERI_API int64_t peri_add_grid(peri_body *b, int32_t material, const double *lo, const double *hi, const int32_t *cells) {
    peri__piece piece;
    PERI_NEED_UNBUILT(b);
    PERI_NEED(b, cells, "cells");
    const int32_t status = peri__tile(b, material, lo, hi, 0.0, cells, &piece);
    return status < 0 ? status : peri__add_lattice(b, material, &piece, NULL, NULL);
}

PERI_API int64_t peri_add_box_part(peri_body *b, int32_t material, const double *lo, const double *hi, double spacing,
                                   const int32_t *first, const int32_t *last) {
    peri__piece piece;
    int64_t count = 1;
    int32_t status = peri__lattice(b, material, lo, hi, spacing, &piece);
    if (status < 0) return status;
    PERI_NEED(b, first, "first");
    PERI_NEED(b, last, "last");
    const double volume = piece.cell[0] * piece.cell[1] * (b->dim == 3 ? piece.cell[2] : 1.0);
    if (!(volume > 0.0 && peri__finite(volume))) return peri__fail(b, PERI_ERROR_RANGE, "spacing", -1, volume);
    for (int32_t d = 0; d < b->dim; ++d) {
        if (first[d] < 0 || first[d] >= piece.cells[d]) return peri__fail(b, PERI_ERROR_RANGE, "first", d, first[d]);
        if (last[d] <= first[d] || last[d] > piece.cells[d]) return peri__fail(b, PERI_ERROR_RANGE, "last", d, last[d]);
        count *= last[d] - first[d];
    }
    status = peri__reserve_points(b, count);
    if (status < 0) return status;
    peri__setup *s = &b->setup;
    for (int64_t k = 0; k < count; ++k) {
        int64_t rest = k;
        for (int32_t d = 0; d < b->dim; ++d) {
            s->local[(s->point_count + k) * b->dim + d] = (double)(first[d] + rest % (last[d] - first[d])) + 0.5;
            rest /= last[d] - first[d];
        }
        s->volume[s->point_count + k] = volume;
        s->material[s->point_count + k] = (uint8_t)(PERI_ID_INDEX(material) - 1);
    }
    piece.count = count;
    s->pieces[s->piece_count++] = piece;
    s->point_count += count;
    return count;
}

PERI_API int64_t peri_add_shape(peri_body *b, int32_t material, const double *lo, const double *hi, double spacing,
                                peri_point_fn inside, void *user) {
    peri__piece piece;
    int32_t status = peri__lattice(b, material, lo, hi, spacing, &piece);
    if (status < 0) return status;
    PERI_NEED(b, inside, "inside");
    return peri__add_lattice(b, material, &piece, inside, user);
}

PERI_API int64_t peri_add_ball(peri_body *b, int32_t material, const double *centre, double radius, double spacing) {
    double lo[3], hi[3];
    peri__piece piece;
    peri__within ball;
    PERI_NEED_UNBUILT(b);
    PERI_NEED_VECTOR(b, centre);
    PERI_NEED_NUMBER(b, radius > 0.0, radius);
    for (int32_t d = 0; d < b->dim; ++d) {
        lo[d] = centre[d] - radius;
        hi[d] = centre[d] + radius;
    }
    int32_t status = peri__lattice(b, material, lo, hi, spacing, &piece);
    if (status < 0) return status;
    ball.centre = centre;
    ball.radius = radius * (1.0 + PERI_HORIZON_TOLERANCE);
    ball.dim = b->dim;
    return peri__add_lattice(b, material, &piece, peri__is_within, &ball);
}

static int64_t peri__vertex_count(const peri__piece *piece, int32_t dim) {
    return (piece->cells[0] + 1) * (piece->cells[1] + 1) * (dim == 3 ? piece->cells[2] + 1 : 1);
}

/* The 2^dim vertices of cell k in cell units; bit d of the corner number is its side on axis d. */
static void peri__cell_vertices(const peri__piece *piece, int32_t dim, int64_t k, double corner[8][3]) {
    int64_t index[3];
    peri__site(piece, k, index);
    for (int32_t c = 0; c < 1 << dim; ++c) {
        int64_t at = 0;
        for (int32_t d = dim - 1; d >= 0; --d) at = at * (piece->cells[d] + 1) + index[d] + (c >> d & 1);
        for (int32_t d = 0; d < dim; ++d)
            corner[c][d] = piece->vertices ? piece->vertices[at * dim + d] : (double)(index[d] + (c >> d & 1));
    }
}

/* Volume and centroid of a bi- or trilinear cell. Two Gauss points per axis are exact: the Jacobian is of degree dim-1 in each
   coordinate and the first moment of degree dim, at most 3. */
static double peri__cell_volume(double corner[8][3], int32_t dim, double *centroid) {
    double volume = 0.0, moment[3] = { 0.0, 0.0, 0.0 };
    for (int32_t g = 0; g < 1 << dim; ++g) {
        double r[3] = { 0.0, 0.0, 0.0 }, x[3] = { 0.0, 0.0, 0.0 }, jacobian[3][3] = { { 0.0 } }, det;
        for (int32_t d = 0; d < dim; ++d) r[d] = 0.5 + (g >> d & 1 ? 1.0 : -1.0) * 0.5 / sqrt(3.0);
        for (int32_t c = 0; c < 1 << dim; ++c) {
            double shape = 1.0;
            for (int32_t d = 0; d < dim; ++d) shape *= c >> d & 1 ? r[d] : 1.0 - r[d];
            for (int32_t d = 0; d < dim; ++d) {
                double slope = c >> d & 1 ? 1.0 : -1.0;
                for (int32_t e = 0; e < dim; ++e)
                    if (e != d) slope *= c >> e & 1 ? r[e] : 1.0 - r[e];
                x[d] += shape * corner[c][d];
                for (int32_t e = 0; e < dim; ++e) jacobian[e][d] += slope * corner[c][e];
            }
        }
        det = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
        if (dim == 3)
            det = jacobian[2][2] * det
                - jacobian[2][1] * (jacobian[0][0] * jacobian[1][2] - jacobian[0][2] * jacobian[1][0])
                + jacobian[2][0] * (jacobian[0][1] * jacobian[1][2] - jacobian[0][2] * jacobian[1][1]);
        det /= (double)(1 << dim);
        volume += det;
        for (int32_t d = 0; d < dim; ++d) moment[d] += det * x[d];
    }
    for (int32_t d = 0; d < dim; ++d) centroid[d] = moment[d] / volume;
    return volume;
}

/* Makes the moved vertices of a piece; 0 where memory is short. */
static int peri__move_vertices(const peri__memory *memory, peri__piece *piece, int32_t dim) {
    const int64_t vertices = peri__vertex_count(piece, dim);
    uint64_t seed = piece->seed;
    int64_t at = 0;
    piece->vertex_bytes = vertices * dim * (int64_t)sizeof(double);
    piece->vertices = (double *)peri__new(memory, piece->vertex_bytes, 1);
    for (int64_t v = 0; piece->vertices && v < vertices; ++v) {
        int64_t rest = v, interior = 1, index[3];
        for (int32_t d = 0; d < dim; ++d) {
            index[d] = rest % (piece->cells[d] + 1);
            rest /= piece->cells[d] + 1;
            interior = interior && index[d] > 0 && index[d] < piece->cells[d];
        }
        for (int32_t d = 0; d < dim; ++d)
            piece->vertices[at++] = (double)index[d] + (interior ? 0.25 * piece->amount * peri__random(&seed) : 0.0);
    }
    return piece->vertices != NULL;
}

PERI_API int64_t peri_add_perturbed_box(peri_body *b, int32_t material, const double *lo, const double *hi, double spacing,
                                        double amount, uint64_t seed) {
    peri__piece piece;
    peri__setup *s;
    int32_t status = peri__lattice(b, material, lo, hi, spacing, &piece);
    if (status < 0) return status;
    PERI_NEED_NUMBER(b, amount >= 0.0 && amount <= 1.0, amount);
    s = &b->setup;

    piece.amount = amount;
    piece.seed = seed;
    if (!peri__move_vertices(&b->memory, &piece, b->dim)) return peri__fail(b, PERI_ERROR_MEMORY, "points", -1, 0.0);
    int64_t added = peri__add_lattice(b, material, &piece, NULL, NULL);
    if (added < 0) {
        peri__delete(&b->memory, piece.vertices, piece.vertex_bytes, 1);
        return added;
    }
    for (int64_t k = 0; k < added; ++k) {
        double corner[8][3];
        peri__cell_vertices(&piece, b->dim, k, corner);
        s->volume[piece.first + k] *= peri__cell_volume(corner, b->dim, &s->local[(piece.first + k) * b->dim]);
    }
    return added;
}

PERI_API int64_t peri_add_points(peri_body *b, int64_t count, const double *positions, const double *volumes,
                                 const int32_t *materials) {
    peri__setup *s;
    PERI_NEED_UNBUILT(b);
    PERI_NEED(b, count >= 0, "count");
    if (count == 0) return peri__fail(b, PERI_ERROR_EMPTY, "count", -1, 0.0);
    PERI_NEED(b, positions, "positions");
    PERI_NEED(b, volumes, "volumes");
    if (!materials && b->material_count != 1)
        return peri__fail(b, b->material_count ? PERI_ERROR_ID_NONE : PERI_ERROR_MATERIAL, "materials", -1, b->material_count);
    s = &b->setup;
    if (count > PERI_POINT_LIMIT - s->point_count) return peri__fail(b, PERI_ERROR_TOO_LARGE, "count", -1, (double)count); /* not read */
    for (int64_t k = 0; k < count; ++k) {
        if (!peri__finite_vector(&positions[k * b->dim], b->dim))
            return peri__fail(b, PERI_ERROR_POINT, "positions", k, peri__not_finite(&positions[k * b->dim], b->dim));
        if (!(volumes[k] > 0.0 && peri__finite(volumes[k])))
            return peri__fail(b, PERI_ERROR_POINT, "volumes", k, volumes[k]);
        const int64_t at = materials ? peri__find(b, PERI_KIND_MATERIAL, materials[k], "materials") : 0;
        if (at < 0) return peri__fail(b, (int32_t)at, "materials", k, materials[k]);
    }
    int32_t status = peri__reserve_points(b, count);
    if (status < 0) return status;
    peri__piece *piece = &s->pieces[s->piece_count++];
    memset(piece, 0, sizeof *piece);
    piece->first = s->point_count;
    piece->count = count;
    memcpy(&s->local[s->point_count * b->dim], positions, (size_t)(count * b->dim) * sizeof(double));
    memcpy(&s->volume[s->point_count], volumes, (size_t)count * sizeof(double));
    for (int64_t k = 0; k < count; ++k) s->material[s->point_count + k] = (uint8_t)(materials ? PERI_ID_INDEX(materials[k]) - 1 : 0);
    s->point_count += count;
    return count;
}

PERI_API int32_t peri_set_families(peri_body *b, int32_t width, const int32_t *ibond) {
    peri__setup *s;
    PERI_NEED_UNBUILT(b);
    PERI_NEED(b, width > 0, "width");
    PERI_NEED(b, ibond, "ibond");
    s = &b->setup;
    if (s->point_count == 0) return peri__fail(b, PERI_ERROR_EMPTY, "ibond", -1, 0.0);
    int64_t entries = s->point_count * width;
    int32_t *copy = (int32_t *)peri__copy(&b->memory, ibond, entries, sizeof(int32_t));
    if (!copy) return peri__fail(b, PERI_ERROR_MEMORY, "ibond", -1, 0.0);
    peri__delete(&b->memory, s->ibond, s->ibond_entries, sizeof(int32_t));
    s->ibond = copy;
    s->ibond_entries = entries;
    s->ibond_width = width;
    return PERI_OK;
}

/* To a multiple of 2^-34: coordinates of lattices of up to 2^18 cells, and their differences, are then exact, so that bonds that are alike
   have the same bits wherever in a body they are. What that moves is 6e-11 of a cell over the length of one. */
static double peri__snapped(double a) { return floor(ldexp(a, 34) + 0.5) * ldexp(1.0, -34); }

/* The frame of a part, for that of its own points. */
static void peri__take_frame(const peri__domain *part, peri__model *m, int32_t dim, double *mean_volume) {
    m->length = part->desc.length;
    *mean_volume = part->desc.mean_volume;
    for (int32_t d = 0; d < dim; ++d) m->origin[d] = part->desc.origin[d];
}

/* The units of the model, and the positions and volumes in them: a lattice's coordinates are exact half-integers when it is
   the body's first piece. */
static void peri__scale_points(const peri_body *b, peri__model *m, double *x) {
    const peri__setup *s = &b->setup;
    const peri__piece *first = &s->pieces[0];
    int32_t dim = b->dim;
    double total = 0.0;
    for (int64_t i = 0; i < s->point_count; ++i) total += s->volume[i] / (double)s->point_count;
    m->length = first->lattice ? first->cell[0] : pow(total, 1.0 / dim);
    for (int32_t d = 0; d < dim; ++d) {
        m->origin[d] = first->lattice ? first->origin[d] : s->local[d];
        for (int64_t i = 0; !first->lattice && i < first->count; ++i)
            if (s->local[i * dim + d] < m->origin[d]) m->origin[d] = s->local[i * dim + d];
    }
    if (s->part) peri__take_frame(s->part, m, dim, &total);
    const double unit = m->length * m->length * (dim == 3 ? m->length : 1.0);
    m->spacing = pow(total / unit, 1.0 / dim); /* a pure number before the root: the same in all units that are powers of two */
    m->horizon = b->desc.horizon / m->length;
    for (int64_t p = 0; p < s->piece_count; ++p) {
        const peri__piece *piece = &s->pieces[p];
        for (int64_t i = piece->first; i < piece->first + piece->count; ++i)
            for (int32_t d = 0; d < dim; ++d) {
                double local = s->local[i * dim + d];
                double from = (piece->origin[d] - m->origin[d]) / m->length, cell = piece->cell[d] / m->length;
                if (s->part) from = peri__snapped(from), cell = peri__snapped(cell);
                x[i * dim + d] = piece->lattice ? from + local * cell : (local - m->origin[d]) / m->length;
                if (fabs(x[i * dim + d]) > m->extent) m->extent = fabs(x[i * dim + d]);
            }
    }
    for (int64_t i = 0; i < s->point_count; ++i) m->volume[i] = s->volume[i] / unit;
}
