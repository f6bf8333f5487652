/* SPDX-License-Identifier: MIT */
/* probes.c - fields at some points, and at any places.

   A place takes the plane that fits the field best around it, in the sense of moving least squares: over the nearest point and those that
   intact bonds join it to, with the weights V_j (1 - r/horizon), r from the place. Linear fields come out as they are, up to the surface.
   At a lattice point inside it is [C] 49 with the linear influence function, the best of [C] table 7, whose oscillations it takes out. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_PLANE_SPAN 1e-4 /* a moment matrix whose eigenvalues differ by more than this factor counts as singular      */

typedef struct peri__reader { /* of a field, point by point                                                              */
    peri_body         *body;
    const peri__field *how;
    int32_t            field, components, ghosts; /* ghosts: 1 where those have the field as their owners have it        */
    double             unit;
    peri_view          view;  /* of a stored field                                                                       */
    double            *whole; /* of a field that is had in one pass alone; else NULL                                      */
    peri__sums         sums;
} peri__reader;

static void peri__close_reader(peri__reader *r) {
    peri__delete(&r->body->scratch, r->whole, r->body->model->points * r->components, sizeof(double));
}

static int32_t peri__open_reader(peri_body *b, int32_t field, peri__reader *r) {
    memset(r, 0, sizeof *r);
    r->body = b;
    r->how = &peri__fields[field - peri__first_field];
    r->field = field;
    r->components = peri__components(field, b->dim);
    r->ghosts = field == PERI_FIELD_POSITION || field == PERI_FIELD_DISPLACEMENT || field == PERI_FIELD_VOLUME;
    r->unit = peri__unit_of(b->model, field);
    r->sums.bad = -1;
    int32_t status = r->how->ensure(b);
    if (status < 0) return status;
    (void)peri__stored_view(b, field, &r->view);
    if (r->how->family) peri__ready_gradients(b);
    if (!r->how->read) return PERI_OK;
    r->whole = (double *)peri__new(&b->scratch, b->model->points * r->components, sizeof(double));
    if (!r->whole) return peri__fail(b, PERI_ERROR_MEMORY, "field", field, 0.0);
    status = peri__compute(b, field, r->whole);
    if (status < 0) peri__close_reader(r);
    return status;
}

/* The field at point i to out[components], units of the caller. */
static void peri__read_at(peri__reader *r, int64_t i, double *out) {
    const peri_body *b = r->body;
    if (r->whole) {
        memcpy(out, &r->whole[i * r->components], (size_t)r->components * sizeof *out);
        return;
    }
    if (r->how->view) {
        for (int32_t d = 0; d < r->components; ++d) out[d] = peri__view_at(&r->view, i, d);
        return;
    }
    if (r->how->point) r->how->point(b, i, out);
    else {
        peri__row row;
        const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
        peri__read_row(b, i, &row);
        r->how->family(b, i, &row, out, &r->sums);
        peri__leave(b, former);
    }
    for (int32_t d = 0; r->unit != 1.0 && d < r->components; ++d) out[d] *= r->unit;
}

/* Closes the reader, and tells what of the caller has failed. */
static int32_t peri__end_reader(peri__reader *r) {
    peri_body *b = r->body;
    peri__close_reader(r);
    if (r->sums.bad < 0) return PERI_OK;
    if (r->sums.n == 0) b->law_bad = r->sums.bad;
    else {
        b->past.said = (int32_t)r->sums.n;
        b->past.said_at = r->sums.bad;
    }
    return peri__heed_laws(b);
}

PERI_API int32_t peri_get_field_at(peri_body *b, int32_t field, int64_t count, const int32_t *points, double *out, int64_t capacity) {
    peri__reader r;
    PERI_NEED_BUILT(b);
    PERI_NEED_CHOICE(b, field, field);
    PERI_NEED(b, count >= 0, "count");
    PERI_NEED(b, points, "points");
    PERI_NEED(b, out, "out");
    const int32_t components = peri__components(field, b->dim);
    if (capacity / components < count) return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)count * components);
    for (int64_t k = 0; k < count; ++k)
        if (points[k] < 0 || points[k] >= b->model->points) return peri__fail(b, PERI_ERROR_INDEX, "points", k, points[k]);
    const int32_t status = peri__open_reader(b, field, &r);
    if (status < 0) return status;
    for (int64_t k = 0; k < count; ++k) peri__read_at(&r, points[k], &out[k * components]);
    return peri__end_reader(&r);
}

/* ---- the nearest point ---------------------------------------------------------------------------------------------- */

/* Points by where they are, in bins: lists as in a hash table. Of few places, and where there is no memory, each point is looked at. */
#define PERI_FEW_PLACES 4
typedef struct peri__bins {
    int32_t *first, *next; /* [count of bins], [points] one of the points there, the next one; -1: none. NULL: no bins     */
    int64_t  count, cells[3];
    double   lo[3], edge;  /* inner units                                                                                */
    double   reach;        /* edge of the largest cell: a place farther than that from all points is outside             */
} peri__bins;

/* Component d of where point i is, inner units. */
static double peri__now_at(const peri_body *b, int in_place, int64_t i, int32_t d) {
    const int64_t at = d * b->model->stride + i;
    return peri__get_real(b->model->x, b->f32, at) + (in_place ? peri__get_real(b->u, b->f32, at) : 0.0);
}

/* The bin of a coordinate, outside of all the nearest. */
static int64_t peri__bin_of(const peri__bins *s, double x, int32_t d) {
    const double at = (x - s->lo[d]) / s->edge;
    return !(at > 0.0) ? 0 : at >= (double)s->cells[d] ? s->cells[d] - 1 : (int64_t)at;
}

/* As many bins as points, and no smaller than spacings. */
static void peri__size_bins(const peri_body *b, int in_place, peri__bins *s) {
    const peri__model *m = b->model;
    double hi[3] = { 0.0, 0.0, 0.0 }, most = 0.0, cells;
    for (int32_t d = 0; d < m->dim; ++d) {
        s->lo[d] = HUGE_VAL;
        hi[d] = -HUGE_VAL;
        for (int64_t i = 0; i < m->points; ++i) {
            const double x = peri__now_at(b, in_place, i, d);
            if (!peri__finite(x)) continue;
            s->lo[d] = fmin(s->lo[d], x);
            hi[d] = fmax(hi[d], x);
        }
        if (!(hi[d] >= s->lo[d])) s->lo[d] = hi[d] = 0.0;
    }
    for (int64_t i = 0; i < m->points; ++i) most = fmax(most, m->volume[i]);
    s->reach = pow(most, 1.0 / m->dim);
    for (s->edge = m->spacing;; s->edge *= 1.25) {
        cells = 1.0;
        for (int32_t d = 0; d < m->dim; ++d) cells *= floor((hi[d] - s->lo[d]) / s->edge) + 1.0;
        if (cells <= (double)m->points) break;
    }
    s->count = 1;
    for (int32_t d = 0; d < 3; ++d) {
        s->cells[d] = d < m->dim ? (int64_t)((hi[d] - s->lo[d]) / s->edge) + 1 : 1;
        s->count *= s->cells[d];
    }
}

static void peri__close_bins(peri_body *b, peri__bins *s) {
    peri__delete(&b->scratch, s->first, s->count, sizeof *s->first);
    peri__delete(&b->scratch, s->next, b->model->points, sizeof *s->next);
    s->first = s->next = NULL;
}

static void peri__open_bins(peri_body *b, int in_place, int64_t places, peri__bins *s) {
    const peri__model *m = b->model;
    memset(s, 0, sizeof *s);
    if (places < PERI_FEW_PLACES) return;
    peri__size_bins(b, in_place, s);
    s->first = (int32_t *)peri__new(&b->scratch, s->count, sizeof *s->first);
    s->next = (int32_t *)peri__new(&b->scratch, m->points, sizeof *s->next);
    if (!s->first || !s->next) {
        peri__close_bins(b, s);
        return;
    }
    for (int64_t k = 0; k < s->count; ++k) s->first[k] = -1;
    for (int64_t i = 0; i < m->points; ++i) {
        int64_t at = 0;
        for (int32_t d = m->dim - 1; d >= 0; --d) at = at * s->cells[d] + peri__bin_of(s, peri__now_at(b, in_place, i, d), d);
        s->next[i] = s->first[at];
        s->first[at] = (int32_t)i;
    }
}

/* The square of how far point i is from a place, as peri_find_point has it. */
static double peri__square_from(const peri_body *b, int in_place, int64_t i, const double *x) {
    double square = 0.0;
    for (int32_t d = 0; d < b->dim; ++d) {
        const double from = x[d] - peri__position(b, i, d) - (in_place ? peri__moved(b, i, d) : 0.0);
        square += peri__square(from / b->model->length);
    }
    return square;
}

/* Looks at the bins that lie `ring` bins from `middle`. */
static void peri__look_in_ring(const peri_body *b, int in_place, const peri__bins *s, const int64_t *middle, int64_t ring, const double *x,
                               int64_t *nearest, double *least) {
    int64_t lo[3], hi[3], at[3];
    for (int d = 0; d < 3; ++d) {
        lo[d] = middle[d] - ring > 0 ? middle[d] - ring : 0;
        hi[d] = peri__min(middle[d] + ring, s->cells[d] - 1);
    }
    for (at[2] = lo[2]; at[2] <= hi[2]; ++at[2])
        for (at[1] = lo[1]; at[1] <= hi[1]; ++at[1])
            for (at[0] = lo[0]; at[0] <= hi[0]; ++at[0]) {
                int64_t off = 0;
                for (int d = 0; d < 3; ++d) {
                    const int64_t away = at[d] > middle[d] ? at[d] - middle[d] : middle[d] - at[d];
                    if (away > off) off = away;
                }
                if (off != ring) continue;
                for (int32_t i = s->first[(at[2] * s->cells[1] + at[1]) * s->cells[0] + at[0]]; i >= 0; i = s->next[i]) {
                    const double square = peri__square_from(b, in_place, i, x);
                    if (square < *least || (square == *least && i < *nearest)) *least = square, *nearest = i;
                }
            }
}

/* The point nearest to a place, of equally near ones the least; or -1 where the place is outside. */
static int64_t peri__nearest(peri_body *b, int in_place, const peri__bins *s, const double *x) {
    int64_t middle[3] = { 0, 0, 0 }, nearest = -1;
    double least = HUGE_VAL;
    if (!s->first) return peri__find_point(b, in_place, x);
    for (int32_t d = 0; d < b->dim; ++d) middle[d] = peri__bin_of(s, (x[d] - b->model->origin[d]) / b->model->length, d);
    for (int64_t ring = 0;; ++ring) {
        const double near_by = ((double)ring - 1e-6) * s->edge; /* what lies in later rings is farther                   */
        peri__look_in_ring(b, in_place, s, middle, ring, x, &nearest, &least);
        if (sqrt(least) < near_by || near_by > s->reach) return nearest;
    }
}

/* ---- places ------------------------------------------------------------------------------------------------------- */

typedef struct peri__probe { /* a place, and the points around it; inner units                                            */
    peri__reader *reader;
    const double *place; /* units of the caller                                                                          */
    int           in_place;
    int64_t       nearest;
    peri__row     row;
    double        weight, middle[3], slope[3]; /* sum w; sum w d/sum w; S^-1 of what the place is off that               */
} peri__probe;

/* The k-th point around the place, the nearest being the last: w, and d from the place. 0 where it does not count. */
static double peri__probe_weight(const peri__probe *p, int64_t k, int64_t *point, double *d) {
    const peri_body *b = p->reader->body;
    const peri__model *m = b->model;
    double square = 0.0;
    if (k < p->row.count && !peri__is_alive(b, p->nearest, k)) return 0.0;
    const int64_t j = *point = k < p->row.count ? p->row.ids[k] : p->nearest;
    if (peri__is_ghost(m, j) && !p->reader->ghosts) return 0.0;
    for (int32_t c = 0; c < m->dim; ++c) {
        d[c] = (peri__position(b, j, c) - p->place[c] + (p->in_place ? peri__moved(b, j, c) : 0.0)) / m->length;
        square += d[c] * d[c];
    }
    return fmax(1.0 - sqrt(square) / m->horizon, 0.0) * m->volume[j];
}

/* Fits the plane. 0 where no point is near enough. */
static int peri__fit_probe(peri__probe *p) {
    const int32_t dim = p->reader->body->dim;
    double d[3], moment[6] = { 0.0 }, inverse[6];
    int64_t j;
    p->weight = 0.0;
    for (int c = 0; c < 3; ++c) p->middle[c] = p->slope[c] = 0.0;
    for (int64_t k = 0; k <= p->row.count; ++k) {
        const double w = peri__probe_weight(p, k, &j, d);
        p->weight += w;
        for (int32_t c = 0; w > 0.0 && c < dim; ++c) p->middle[c] += w * d[c];
    }
    if (!(p->weight > 0.0)) return 0;
    for (int32_t c = 0; c < dim; ++c) p->middle[c] /= p->weight;
    for (int64_t k = 0; k <= p->row.count; ++k) {
        const double w = peri__probe_weight(p, k, &j, d);
        for (int32_t a = 0; w > 0.0 && a < dim; ++a)
            for (int32_t c = a; c < dim; ++c) moment[peri__packed(dim, a, c)] += w * (d[a] - p->middle[a]) * (d[c] - p->middle[c]);
    }
    (void)peri__invert(dim, moment, PERI_PLANE_SPAN, inverse);
    for (int32_t a = 0; a < dim; ++a)
        for (int32_t c = 0; c < dim; ++c) p->slope[a] -= inverse[peri__packed(dim, a, c)] * p->middle[c];
    return 1;
}

/* Is the place farther than the edge of a cell from the nearest point, or is that of another part? */
static int peri__probe_is_outside(const peri__probe *p) {
    const peri_body *b = p->reader->body;
    const peri__model *m = b->model;
    if (p->nearest < 0 || peri__is_ghost(m, p->nearest)) return 1;
    return !(sqrt(peri__square_from(b, p->in_place, p->nearest, p->place)) <= pow(m->volume[p->nearest], 1.0 / m->dim));
}

static void peri__probe_place(peri__probe *p, double *out) {
    const int32_t components = p->reader->components, dim = p->reader->body->dim;
    double value[9], d[3];
    int64_t j;
    int inside = !peri__probe_is_outside(p);
    if (inside) peri__read_row(p->reader->body, p->nearest, &p->row);
    inside = inside && peri__fit_probe(p);
    for (int32_t n = 0; n < components; ++n) out[n] = inside ? 0.0 : (double)NAN;
    for (int64_t k = 0; inside && k <= p->row.count; ++k) {
        const double w = peri__probe_weight(p, k, &j, d);
        double part = 1.0 / p->weight;
        if (!(w > 0.0)) continue;
        for (int32_t c = 0; c < dim; ++c) part += (d[c] - p->middle[c]) * p->slope[c];
        peri__read_at(p->reader, j, value);
        for (int32_t n = 0; n < components; ++n) out[n] += w * part * value[n];
    }
}

PERI_API int32_t peri_interpolate_field(peri_body *b, int32_t field, int32_t in_place, int64_t count, const double *places, double *out,
                                        int64_t capacity) {
    peri__reader r;
    peri__probe p;
    peri__bins bins;
    PERI_NEED_BUILT(b);
    PERI_NEED_CHOICE(b, field, field);
    PERI_NEED_FLAG(b, in_place);
    PERI_NEED(b, count >= 0, "count");
    PERI_NEED(b, places, "places");
    PERI_NEED(b, out, "out");
    const int32_t components = peri__components(field, b->dim);
    if (capacity / components < count) return peri__fail(b, PERI_ERROR_CAPACITY, "capacity", -1, (double)count * components);
    for (int64_t k = 0; k < count; ++k)
        if (!peri__finite_vector(&places[k * b->dim], b->dim))
            return peri__fail(b, PERI_ERROR_RANGE, "places", k, peri__not_finite(&places[k * b->dim], b->dim));
    const int32_t status = peri__open_reader(b, field, &r);
    if (status < 0) return status;
    p.reader = &r;
    p.in_place = in_place;
    peri__open_bins(b, in_place, count, &bins);
    for (int64_t k = 0; k < count; ++k) {
        p.place = &places[k * b->dim];
        p.nearest = peri__nearest(b, in_place, &bins, p.place);
        peri__probe_place(&p, &out[k * components]);
    }
    peri__close_bins(b, &bins);
    return peri__end_reader(&r);
}
