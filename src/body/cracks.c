/* SPDX-License-Identifier: MIT */
/* cracks.c - cuts, no-fail zones, break events.

   A crack is a convex region: a flat polygon, thickened by the touching tolerance, is an intersection of half-spaces; a disc is a slab
   and a cylinder. A bond is cut where its segment meets the region. Crossing, touching and lying in the plane are then the same case,
   and nothing divides by the small numbers that they produce. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_FACES 6
typedef struct peri__crack {
    int     faces;
    double  normal[PERI_FACES][3], limit[PERI_FACES]; /* inside where normal.x <= limit; inner units                     */
    double  centre[3], axis[3], radius;               /* disc: |x - centre - axis part| <= radius too; radius 0: no disc */
    double  lo[3], hi[3];                             /* bounding box                                                    */
} peri__crack;

/* Does the segment a-b meet the region? Clips the parameter range by each half-space ([lo, hi] of a + t(b-a)). */
static int peri__meets(const peri__crack *c, const double *a, const double *b, int32_t dim) {
    double lo = 0.0, hi = 1.0;
    for (int k = 0; k < c->faces; ++k) {
        double da = peri__dot(c->normal[k], a, dim) - c->limit[k], db = peri__dot(c->normal[k], b, dim) - c->limit[k];
        if (da > 0.0 && db > 0.0) return 0;
        if (da > 0.0) {
            double t = da / (da - db);
            if (t > lo) lo = t;
        } else if (db > 0.0) {
            double t = da / (da - db);
            if (t < hi) hi = t;
        }
    }
    if (lo > hi) return 0;
    if (c->radius > 0.0) {
        /* nearest approach to the axis of the part that is within the slab */
        double p[3], q[3], pp, pq = 0.0, qq = 0.0, t;
        for (int32_t d = 0; d < 3; ++d) {
            p[d] = a[d] + lo * (b[d] - a[d]) - c->centre[d];
            q[d] = (hi - lo) * (b[d] - a[d]);
        }
        double pn = peri__dot(p, c->axis, 3), qn = peri__dot(q, c->axis, 3);
        for (int32_t d = 0; d < 3; ++d) {
            p[d] -= pn * c->axis[d];
            q[d] -= qn * c->axis[d];
            pq += p[d] * q[d];
            qq += q[d] * q[d];
        }
        t = qq > 0.0 ? -pq / qq : 0.0;
        t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
        pp = 0.0;
        for (int32_t d = 0; d < 3; ++d) pp += peri__square(p[d] + t * q[d]);
        return pp <= c->radius * c->radius;
    }
    return 1;
}

static void peri__add_face(peri__crack *c, const double *normal, const double *point, double tolerance, int32_t dim) {
    double length = sqrt(peri__dot(normal, normal, dim));
    for (int32_t d = 0; d < dim; ++d) c->normal[c->faces][d] = normal[d] / length;
    c->limit[c->faces] = peri__dot(c->normal[c->faces], point, dim) + tolerance;
    c->faces++;
}

static int32_t peri__check_standing(peri_body *b, int32_t standing) {
    PERI_NEED_CHOICE(b, standing, standing);
    if (standing == PERI_CUT_INITIAL && b->now.steps > 0) return peri__fail(b, PERI_ERROR_ORDER, "standing", -1, standing);
    return PERI_OK;
}

/* Flags for cuts, taken on the first: alive for every bond, and which of them is not part of the initial crack. */
static int32_t peri__need_flags(peri_body *b, int32_t standing) {
    const int initial = standing == PERI_CUT_INITIAL;
    const int32_t status = peri__check_standing(b, standing);
    if (status < 0) return status;
    if (initial && !b->uncut) b->uncut = peri__new_flags(b);
    if ((initial && !b->uncut) || !peri__need_alive(b)) return peri__fail(b, PERI_ERROR_MEMORY, "damage", -1, 0.0);
    return PERI_OK;
}

/* Is the bond i-j counted by its direction from i? So is one of its two directions, on one part; and of a bond in a periodic cell, which
   images show twice, the one that leads up from the lower of the two points that they are images of. */
static int peri__counts(const peri_body *b, int64_t i, int64_t j) {
    const peri__model *m = b->model;
    double xi[3];
    int32_t d = 0;
    if (!m->part) return i < j;
    if (m->part->depth[i]) return 0;
    const int64_t source = peri__source_of(m->part, j);
    if (source != i) return i < (source < 0 ? j : source);
    peri__bond_of(m, m->f32, i, j, xi);
    while (d + 1 < m->dim && fabs(xi[d]) <= peri__image_play(b)) ++d;
    return xi[d] > 0.0;
}

/* Cuts bond k of row i, one direction; returns 1 where it was whole. */
static int peri__cut_one(peri_body *b, int32_t standing, int64_t i, int64_t k) {
    uint32_t flag = (uint32_t)1 << (k % 32), *alive = &b->alive[i * b->model->words + k / 32];
    if (!(*alive & flag)) return 0;
    *alive &= ~flag;
    if (standing == PERI_CUT_INITIAL) {
        b->uncut[i * b->model->words + k / 32] &= ~flag;
        b->now.cut += !peri__is_ghost(b->model, i);
    } else {
        b->now.broken += !peri__is_ghost(b->model, i);
    }
    return 1;
}

typedef struct peri__cutter {
    peri_body         *body;
    const peri__crack *crack;
    int32_t            standing;
} peri__cutter;

/* Component d of where point i is cut, inner units. */
static double peri__cut_at(const peri_body *b, int32_t standing, int64_t i, int32_t d) {
    const int64_t at = d * b->model->stride + i;
    return peri__get_real(b->model->x, b->f32, at) + (standing == PERI_CUT_IN_PLACE ? peri__get_real(b->u, b->f32, at) : 0.0);
}

/* Each row cuts its own direction. The test takes the ends in ascending order, so both directions agree to the last bit. */
static void peri__cut_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__cutter *cutter = (const peri__cutter *)context;
    peri_body *b = cutter->body;
    const peri__model *m = b->model;
    int32_t dim = m->dim;
    peri__row row;
    for (int64_t i = begin; i < end; ++i) {
        double xi[3], xj[3];
        peri__read_row(b, i, &row);
        for (int32_t d = 0; d < dim; ++d) xi[d] = peri__cut_at(b, cutter->standing, i, d);
        for (int64_t k = 0; k < row.count; ++k) {
            int64_t j = row.ids[k];
            uint32_t flag = (uint32_t)1 << (k % 32), *alive = &b->alive[i * m->words + k / 32];
            int near_crack = 1;
            for (int32_t d = 0; d < dim; ++d) {
                xj[d] = peri__cut_at(b, cutter->standing, j, d);
                near_crack = near_crack && (xi[d] >= cutter->crack->lo[d] || xj[d] >= cutter->crack->lo[d])
                          && (xi[d] <= cutter->crack->hi[d] || xj[d] <= cutter->crack->hi[d]);
            }
            if (!near_crack || !(*alive & flag)) continue;
            if (!peri__meets(cutter->crack, i < j ? xi : xj, i < j ? xj : xi, dim)) continue;
            *alive &= ~flag;
            if (cutter->standing == PERI_CUT_INITIAL) b->uncut[i * m->words + k / 32] &= ~flag;
            if (!peri__is_ghost(m, i)) sums->n++;
            sums->a += peri__counts(b, i, j);
        }
    }
}

static int64_t peri__apply_crack(peri_body *b, int32_t standing, const peri__crack *crack) {
    peri__cutter cutter;
    int32_t status = peri__need_flags(b, standing);
    if (status == PERI_OK) status = peri__alter(b, PERI__CUTS);
    if (status < 0) return status;
    cutter.body = b;
    cutter.crack = crack;
    cutter.standing = standing;
    peri__for_points(b, b->model->points, 2 * b->model->width, peri__cut_block, &cutter, b->sums);
    const peri__sums total = peri__total(b->sums, b->model->points);
    const int64_t cut = total.n;
    if (standing == PERI_CUT_INITIAL) b->now.cut += cut;
    else b->now.broken += cut;
    peri__note_cuts(b, standing);
    if (cut == 0 && !b->model->part) peri__log(b, 1, "the crack meets no bond that was whole");
    return (int64_t)total.a;
}

/* The flat convex polygon with `count` vertices (2 in 2D, 3 or 4 in 3D), thickened by the tolerance. */
static int64_t peri__cut_polygon(peri_body *b, int32_t standing, int count, double vertex[4][3]) {
    peri__crack crack;
    int32_t dim = b->dim;
    double touch = peri__touching(b), normal[3] = { 0.0, 0.0, 0.0 };
    double edge[3] = { 0.0, 0.0, 0.0 }, other[3] = { 0.0, 0.0, 0.0 }, extent = 0.0;
    memset(&crack, 0, sizeof crack);
    for (int32_t d = 0; d < dim; ++d) {
        edge[d] = vertex[1][d] - vertex[0][d];
        other[d] = dim == 3 ? vertex[count - 1][d] - vertex[0][d] : 0.0;
        extent += fabs(edge[d]) + fabs(other[d]);
    }
    if (dim == 2) {
        normal[0] = -edge[1];
        normal[1] = edge[0];
    } else {
        peri__cross(edge, other, normal);
    }
    double area = sqrt(peri__dot(normal, normal, dim));
    if (!(area > 1e-12 * (dim == 2 ? extent : extent * extent)) || !peri__finite(area))
        return peri__fail(b, PERI_ERROR_CRACK, count == 2 ? "to" : count == 3 ? "r" : "edge2", -1, 0.0);
    for (int side = 0; side < 2; ++side) {
        peri__add_face(&crack, normal, vertex[0], touch, dim);
        for (int32_t d = 0; d < dim; ++d) normal[d] = -normal[d];
    }
    for (int k = 0; k < count; ++k) { /* outward normals of the rim, in the plane */
        const double *p = vertex[k], *q = vertex[(k + 1) % count];
        double out[3];
        for (int32_t d = 0; d < dim; ++d) edge[d] = q[d] - p[d];
        if (dim == 3) peri__cross(edge, normal, out);
        peri__add_face(&crack, dim == 3 ? out : edge, dim == 3 ? p : q, touch, dim);
    }
    for (int32_t d = 0; d < dim; ++d) {
        crack.lo[d] = crack.hi[d] = vertex[0][d];
        for (int k = 1; k < count; ++k) {
            if (vertex[k][d] < crack.lo[d]) crack.lo[d] = vertex[k][d];
            if (vertex[k][d] > crack.hi[d]) crack.hi[d] = vertex[k][d];
        }
        crack.lo[d] -= 2.0 * touch;
        crack.hi[d] += 2.0 * touch;
    }
    return peri__apply_crack(b, standing, &crack);
}

#define PERI_NEED_SPACE(b, need)                                                                                       \
    if ((b)->dim != (need)) return peri__fail((b), PERI_ERROR_CRACK, "space", -1, (b)->dim)

PERI_API int64_t peri_cut_segment(peri_body *b, int32_t standing, const double *from, const double *to) {
    double vertex[4][3];
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_SPACE(b, 2);
    PERI_NEED_VECTOR(b, from);
    PERI_NEED_VECTOR(b, to);
    peri__inner(b, from, vertex[0]);
    peri__inner(b, to, vertex[1]);
    return peri__cut_polygon(b, standing, 2, vertex);
}

PERI_API int64_t peri_cut_polyline(peri_body *b, int32_t standing, int64_t count, const double *vertices) {
    int64_t cut = 0;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_SPACE(b, 2);
    PERI_NEED(b, count >= 2, "count");
    PERI_NEED(b, vertices, "vertices");
    for (int64_t k = 0; k < count; ++k) { /* all is checked before anything is cut */
        if (!peri__finite_vector(&vertices[2 * k], 2))
            return peri__fail(b, PERI_ERROR_RANGE, "vertices", k, peri__not_finite(&vertices[2 * k], 2));
        double here[2], last[2], edge[2];
        peri__inner(b, &vertices[2 * k], here);
        peri__inner(b, &vertices[k > 0 ? 2 * k - 2 : 0], last);
        for (int d = 0; d < 2; ++d) edge[d] = here[d] - last[d];
        double length = sqrt(peri__dot(edge, edge, 2));
        if (k > 0 && !(length > 0.0 && peri__finite(length))) return peri__fail(b, PERI_ERROR_CRACK, "vertices", k, 0.0);
    }
    for (int64_t k = 0; k + 1 < count; ++k) {
        int64_t more = peri_cut_segment(b, standing, &vertices[2 * k], &vertices[2 * k + 2]);
        if (more < 0) return more;
        cut += more;
    }
    return cut;
}

PERI_API int64_t peri_cut_triangle(peri_body *b, int32_t standing, const double *p, const double *q, const double *r) {
    double vertex[4][3];
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_SPACE(b, 3);
    PERI_NEED_VECTOR(b, p);
    PERI_NEED_VECTOR(b, q);
    PERI_NEED_VECTOR(b, r);
    peri__inner(b, p, vertex[0]);
    peri__inner(b, q, vertex[1]);
    peri__inner(b, r, vertex[2]);
    return peri__cut_polygon(b, standing, 3, vertex);
}

PERI_API int64_t peri_cut_rectangle(peri_body *b, int32_t standing, const double *corner, const double *edge1, const double *edge2) {
    double vertex[4][3];
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_SPACE(b, 3);
    PERI_NEED_VECTOR(b, corner);
    PERI_NEED_VECTOR(b, edge1);
    PERI_NEED_VECTOR(b, edge2);
    peri__inner(b, corner, vertex[0]);
    for (int d = 0; d < 3; ++d) {
        vertex[1][d] = vertex[0][d] + edge1[d] / b->model->length;
        vertex[2][d] = vertex[1][d] + edge2[d] / b->model->length;
        vertex[3][d] = vertex[0][d] + edge2[d] / b->model->length;
    }
    return peri__cut_polygon(b, standing, 4, vertex);
}

PERI_API int64_t peri_cut_disc(peri_body *b, int32_t standing, const double *centre, const double *normal, double radius) {
    peri__crack crack;
    double opposite[3], touch;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_SPACE(b, 3);
    PERI_NEED_VECTOR(b, centre);
    PERI_NEED_VECTOR(b, normal);
    PERI_NEED_NUMBER(b, radius >= 0.0, radius);
    memset(&crack, 0, sizeof crack);
    if (!peri__direction(normal, 3, crack.axis) || !(radius > 0.0))
        return peri__fail(b, PERI_ERROR_CRACK, radius > 0.0 ? "normal" : "radius", -1, 0.0);
    touch = peri__touching(b);
    peri__inner(b, centre, crack.centre);
    crack.radius = radius / b->model->length + touch;
    for (int d = 0; d < 3; ++d) {
        opposite[d] = -crack.axis[d];
        crack.lo[d] = crack.centre[d] - crack.radius - touch;
        crack.hi[d] = crack.centre[d] + crack.radius + touch;
    }
    peri__add_face(&crack, crack.axis, crack.centre, touch, 3);
    peri__add_face(&crack, opposite, crack.centre, touch, 3);
    return peri__apply_crack(b, standing, &crack);
}

PERI_API int64_t peri_cut_pairs(peri_body *b, int32_t standing, int64_t count, const int32_t *pairs) {
    int64_t cut = 0;
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED(b, count >= 0, "count");
    PERI_NEED(b, pairs || count == 0, "pairs");
    for (int64_t k = 0; k < count; ++k) {
        int32_t i = pairs[2 * k], j = pairs[2 * k + 1];
        if (i < 0 || j < 0 || i >= b->model->points || j >= b->model->points)
            return peri__fail(b, PERI_ERROR_INDEX, "pairs", k, i < 0 || i >= b->model->points ? i : j);
        if (peri__find_bond(b->model, i, j) < 0) return peri__fail(b, PERI_ERROR_PAIR, "pairs", k, 0.0);
    }
    int32_t status = peri__need_flags(b, standing);
    if (status == PERI_OK) status = peri__alter(b, PERI__CUTS);
    if (status < 0) return status;
    for (int64_t k = 0; k < count; ++k) {
        int32_t i = pairs[2 * k], j = pairs[2 * k + 1];
        const int counts = peri__counts(b, i, j) || peri__counts(b, j, i);
        if (peri__cut_one(b, standing, i, peri__find_bond(b->model, i, j))) cut += counts;
        (void)peri__cut_one(b, standing, j, peri__find_bond(b->model, j, i));
    }
    peri__note_cuts(b, standing);
    return cut;
}

/* Flags those bonds i < j that `cut` takes, by the row of i. What it returned last, or 0. */
static int32_t peri__choose_cuts(const peri_body *b, int32_t standing, peri_pair_fn cut, void *user, uint32_t *chosen) {
    const peri__model *m = b->model;
    for (int64_t i = 0; i < m->points; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int64_t j = row.ids[k];
            double xi[3], xj[3];
            if (j < i || !peri__is_alive(b, i, k)) continue;
            for (int32_t d = 0; d < m->dim; ++d) {
                xi[d] = m->origin[d] + m->length * peri__cut_at(b, standing, i, d);
                xj[d] = m->origin[d] + m->length * peri__cut_at(b, standing, j, d);
            }
            const int32_t said = cut(user, (int32_t)i, (int32_t)j, xi, xj);
            if (said < 0) return said;
            if (said > 0) chosen[i * m->words + k / 32] |= (uint32_t)1 << (k % 32);
        }
    }
    return 0;
}

/* Cuts the bonds flagged. */
static int64_t peri__cut_chosen(peri_body *b, int32_t standing, const uint32_t *chosen) {
    const peri__model *m = b->model;
    int64_t count = 0;
    const int32_t status = peri__alter(b, PERI__CUTS);
    if (status < 0) return status;
    for (int64_t i = 0; i < m->points; ++i) {
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            if (!(chosen[i * m->words + k / 32] >> (k % 32) & 1)) continue;
            const int counts = peri__counts(b, i, row.ids[k]) || peri__counts(b, row.ids[k], i);
            if (peri__cut_one(b, standing, i, k)) count += counts;
            (void)peri__cut_one(b, standing, row.ids[k], peri__find_bond(m, row.ids[k], i));
        }
    }
    peri__note_cuts(b, standing);
    return count;
}

PERI_API int64_t peri_cut_if(peri_body *b, int32_t standing, peri_pair_fn cut, void *user) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED(b, cut, "cut");
    const int64_t words = b->model->points * b->model->words;
    int64_t status = peri__check_standing(b, standing);
    if (status < 0) return status;
    uint32_t *chosen = (uint32_t *)peri__new(&b->scratch, words, sizeof *chosen);
    if (!chosen) return peri__fail(b, PERI_ERROR_MEMORY, "cut", -1, 0.0);
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    const int32_t said = peri__choose_cuts(b, standing, cut, user, chosen);
    peri__leave(b, former);
    if (said < 0) status = peri__fail(b, PERI_ERROR_CALLBACK, "peri_pair_fn", -1, said);
    if (status == PERI_OK) status = peri__need_flags(b, standing);
    if (status == PERI_OK) status = peri__cut_chosen(b, standing, chosen);
    peri__delete(&b->scratch, chosen, words, sizeof *chosen);
    return status;
}

PERI_API int32_t peri_bond_is_intact(peri_body *b, int32_t i, int32_t j) {
    PERI_NEED_BUILT(b);
    if (i < 0 || i >= b->model->points || j < 0 || j >= b->model->points)
        return peri__fail(b, PERI_ERROR_INDEX, i < 0 || i >= b->model->points ? "i" : "j", i < 0 || i >= b->model->points ? i : j, 0.0);
    int64_t k = peri__find_bond(b->model, i, j);
    if (k < 0) return peri__fail(b, PERI_ERROR_PAIR, "j", i, j);
    return peri__is_alive(b, i, k);
}

PERI_API int32_t peri_set_no_fail(peri_body *b, int32_t id, int32_t on) {
    PERI_NEED_CHANGEABLE(b);
    PERI_NEED_FLAG(b, on);
    const int32_t set = peri__find_set(b, id);
    if (set < 0) return set;
    uint8_t *fresh = NULL;
    if (!b->no_fail) {
        fresh = b->no_fail = (uint8_t *)peri__new(&b->memory, b->model->points, 1);
        if (!fresh) return peri__fail(b, PERI_ERROR_MEMORY, "damage", -1, 0.0);
    }
    int32_t status = peri__update_classes(b); /* takes memory, so before anything changes */
    if (status < 0) {
        peri__delete(&b->memory, fresh, b->model->points, 1);
        b->no_fail = NULL;
        (void)peri__update_classes(b);
        return peri__fail(b, PERI_ERROR_MEMORY, "laws", -1, 0.0);
    }
    for (int64_t k = 0; k < peri__set_all(b, set); ++k) b->no_fail[peri__set_any(b, set, k)] = (uint8_t)on;
    return peri__update_classes(b);
}

PERI_API int32_t peri_on_break(peri_body *b, peri_break_fn fn, void *user) {
    PERI_NEED_CHANGEABLE(b);
    if (fn && !b->before) {
        b->before = (uint32_t *)peri__new(&b->memory, b->model->points * b->model->words, sizeof *b->before);
        if (!b->before) return peri__fail(b, PERI_ERROR_MEMORY, "peri_on_break", -1, 0.0);
    } else if (!fn) {
        peri__delete(&b->memory, b->before, b->model->points * b->model->words, sizeof *b->before);
        b->before = NULL;
    }
    b->on_break = fn;
    b->break_user = user;
    return PERI_OK;
}

/* Reports the bonds that broke in this step: all of them, until the callback fails, which ends reports for the run. */
static void peri__report_breaks(peri_body *b) {
    const peri__model *m = b->model;
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    for (int64_t i = 0; i < m->points && b->break_said >= 0; ++i) {
        if (peri__is_ghost(m, i)) continue;
        if (memcmp(&b->before[i * m->words], &b->alive[i * m->words], (size_t)m->words * sizeof *b->alive) == 0) continue;
        peri__row row;
        peri__read_row(b, i, &row);
        for (int64_t k = peri__next_bond(&row, m->part ? -1 : i); k >= 0 && b->break_said >= 0; k = peri__next_bond(&row, row.ids[k])) {
            int64_t at = i * m->words + k / 32, j = row.ids[k];
            if (!((b->before[at] & ~b->alive[at]) >> (k % 32) & 1) || !peri__counts(b, i, j)) continue;
            const int32_t said = b->on_break(b->break_user, (int32_t)i, (int32_t)j, peri__load_time(b), peri__stretch(b, i, &row, k));
            if (said < 0 || b->break_said == 0) b->break_said = said;
        }
    }
    peri__leave(b, former);
}
