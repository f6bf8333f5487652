/* SPDX-License-Identifier: MIT */
/* cracks.c - the cracks of a body: paths in 2D (paths.c), in 3D the sides between cells; VTP for ParaView. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_COOKIE_CRACKS (UINT64_C(0x7065726900080000) + sizeof(peri_cracks_desc))
#define PERI_FLAT_PATCH 1e-6 /* a patch of sides whose second extent is less than root of this of its first has no normal   */

PERI_API void peri_cracks_desc_init(peri_cracks_desc *d) {
    if (!d) return;
    memset(d, 0, sizeof *d);
    d->cookie = PERI_COOKIE_CRACKS;
    d->initial = 1;
    d->shortest = (double)NAN;
}

/* ---- sides in 3D -------------------------------------------------------------------------------------------------- */

typedef struct peri__patch { /* cracked sides of a body in 3D                                                             */
    peri_body    *body;
    const peri_cracks_desc *desc;
    peri_cracks  *out;
    peri__sorter  sorter;
    int32_t      *degree; /* [points] how many are adjacent to it                                                        */
    int64_t      *start;  /* [points+1] cracked sides of the points before, each with its lower point                    */
    int64_t       sides;
    int32_t      *end;    /* [sides][2]                                                                                  */
    double       *middle; /* [sides][3] reference, inner units                                                           */
    int32_t       failed;
} peri__patch;

static void peri__look_at_point(peri__patch *p, int64_t i, peri__row *row) {
    const peri_body *b = p->body;
    const peri__model *m = b->model;
    int broken = 0;
    peri__read_row(b, i, row);
    for (int64_t k = 0; k < row->count && !broken; ++k) broken = !peri__is_alive(b, i, k);
    if (!broken) return;
    p->degree[i] = (int32_t)peri__sides_of(m, i, row, -1, &p->sorter);
    const int64_t count = peri__upper_sides_of(b, i, row, &p->sorter);
    for (int64_t n = 0; n < count; ++n) {
        const int64_t k = p->sorter.bond[n];
        const double time = peri__time_of_side(b, p->desc->initial, i, k, n);
        if (time == PERI_UNBROKEN) continue;
        if (p->end) {
            p->end[2 * p->sides] = (int32_t)i;
            p->end[2 * p->sides + 1] = row->ids[k];
            p->out->time[4 * p->sides] = time;
            for (int d = 0; d < 3; ++d)
                p->middle[3 * p->sides + d] = 0.5 * (peri__place_at(b, 0, i, d) + peri__place_at(b, 0, row->ids[k], d));
        }
        p->sides++;
    }
}

/* The area of the side between two cells: the pyramid on it is a sixth of each of them. Where more than six points are adjacent to one,
   their sides are smaller. */
static double peri__area_of_side(const peri__patch *p, int64_t s, double bond) {
    double area = 0.0;
    for (int e = 0; e < 2; ++e) {
        const int64_t i = p->end[2 * s + e];
        const int32_t degree = p->degree[i] > 6 ? p->degree[i] : 6;
        area += 0.5 * 6.0 * p->body->model->volume[i] / (degree * bond);
    }
    return area;
}

/* The cosine between a bond and the normal of the crack, which is that of the plane through the sides within a horizon. 1 where they make
   none. */
static double peri__lean_of_side(const peri__patch *p, int64_t s, const double *along) {
    const peri__model *m = p->body->model;
    double sum[3] = { 0.0, 0.0, 0.0 }, square[6] = { 0.0 }, full[9], v[9], count = 0.0;
    peri__row row;
    peri__read_row(p->body, p->end[2 * s], &row);
    for (int64_t k = -1; k < row.count; ++k) {
        const int64_t i = k < 0 ? p->end[2 * s] : row.ids[k];
        for (int64_t n = p->start[i]; n < p->start[i + 1]; ++n) {
            double xi[3];
            for (int d = 0; d < 3; ++d) xi[d] = p->middle[3 * n + d] - p->middle[3 * s + d];
            if (peri__dot(xi, xi, 3) > m->horizon * m->horizon) continue;
            count += 1.0;
            for (int a = 0; a < 3; ++a) {
                sum[a] += xi[a];
                for (int c = a; c < 3; ++c) square[peri__packed(3, a, c)] += xi[a] * xi[c];
            }
        }
    }
    for (int a = 0; a < 3; ++a)
        for (int c = a; c < 3; ++c) square[peri__packed(3, a, c)] -= sum[a] * sum[c] / count;
    peri__eigen(3, square, full, v);
    int least = 0, most = 0;
    for (int d = 1; d < 3; ++d) {
        if (full[4 * d] < full[4 * least]) least = d;
        if (full[4 * d] >= full[4 * most]) most = d;
    }
    if (least == most || !(full[4 * (3 - least - most)] > PERI_FLAT_PATCH * full[4 * most])) return 1.0;
    double lean = 0.0;
    for (int d = 0; d < 3; ++d) lean += along[d] * v[3 * d + least];
    return fabs(lean);
}

/* A square of that area across the bond, its edges along the axes as far as may be. */
static void peri__draw_side(const peri__patch *p, int64_t s, double *line) {
    const peri_body *b = p->body;
    double xi[3] = { 0.0, 0.0, 0.0 }, along[3], edge[3] = { 0.0, 0.0, 0.0 }, other[3], middle[3];
    peri__bond_of(b->model, b->f32, p->end[2 * s], p->end[2 * s + 1], xi);
    const double bond = sqrt(peri__dot(xi, xi, 3)), area = peri__area_of_side(p, s, bond), half = 0.5 * sqrt(area);
    for (int d = 0; d < 3; ++d) along[d] = xi[d] / bond;
    p->out->size += area * peri__lean_of_side(p, s, along) * peri__square(b->model->length);
    int axis = 0;
    for (int d = 0; d < 3; ++d) {
        middle[d] = 0.5 * (peri__place_at(b, p->desc->current, p->end[2 * s], d)
                           + peri__place_at(b, p->desc->current, p->end[2 * s + 1], d));
        if (fabs(along[d]) < fabs(along[axis])) axis = d;
    }
    for (int d = 0; d < 3; ++d) edge[d] = (d == axis) - along[axis] * along[d];
    (void)peri__direction(edge, 3, edge);
    peri__cross(along, edge, other);
    for (int c = 0; c < 4; ++c)
        for (int d = 0; d < 3; ++d)
            line[3 * c + d] = middle[d] + half * ((c == 0 || c == 3 ? -1.0 : 1.0) * edge[d] + (c < 2 ? -1.0 : 1.0) * other[d]);
}

static void peri__fill_patch(peri__patch *p) {
    const int64_t points = p->body->model->points;
    peri_cracks *c = p->out;
    peri__row row;
    p->sides = 0;
    for (int64_t i = 0; i < points; ++i) {
        p->start[i] = p->sides;
        peri__look_at_point(p, i, &row);
    }
    p->start[points] = p->sides;
    for (int64_t s = 0; s < p->sides; ++s) {
        double line[12];
        peri__draw_side(p, s, line);
        for (int k = 0; k < 12; ++k)
            c->vertex[12 * s + k] = p->body->model->origin[k % 3] + p->body->model->length * line[k];
        for (int k = 1; k < 4; ++k) c->time[4 * s + k] = c->time[4 * s];
        c->start[s + 1] = 4 * (s + 1);
    }
}

/* The sides that cracks run along in 3D. 0 where memory is short. */
static int peri__find_patch(peri_body *b, const peri_cracks_desc *desc, peri_cracks *c) {
    const int64_t points = b->model->points;
    peri__patch p;
    peri__row row;
    memset(&p, 0, sizeof p);
    p.body = b;
    p.desc = desc;
    p.out = c;
    if (!peri__open_sorter(b, &p.sorter)) return 0;
    p.degree = (int32_t *)peri__new(&b->scratch, points, sizeof *p.degree);
    p.start = (int64_t *)peri__new(&b->scratch, points + 1, sizeof *p.start);
    int ok = p.degree && p.start;
    for (int64_t i = 0; ok && i < points; ++i) peri__look_at_point(&p, i, &row);
    const int64_t sides = p.sides;
    ok = ok && peri__grow(&c->memory, &c->start, &c->path_capacity, sides + 1, sizeof *c->start)
      && peri__grow(&c->memory, &c->vertex, &c->vertex_capacity, 12 * sides, sizeof *c->vertex)
      && peri__grow(&c->memory, &c->time, &c->time_capacity, 4 * sides, sizeof *c->time);
    p.end = ok ? (int32_t *)peri__new(&b->scratch, 2 * sides, sizeof *p.end) : NULL;
    p.middle = ok ? (double *)peri__new(&b->scratch, 3 * sides, sizeof *p.middle) : NULL;
    ok = p.end && p.middle;
    if (ok) peri__fill_patch(&p);
    if (ok) {
        c->paths = sides;
        c->vertices = 4 * sides;
    }
    peri__delete(&b->scratch, p.end, 2 * sides, sizeof *p.end);
    peri__delete(&b->scratch, p.middle, 3 * sides, sizeof *p.middle);
    peri__delete(&b->scratch, p.degree, points, sizeof *p.degree);
    peri__delete(&b->scratch, p.start, points + 1, sizeof *p.start);
    peri__close_sorter(&p.sorter);
    return ok;
}

/* ---- calls -------------------------------------------------------------------------------------------------------- */

PERI_API void peri_cracks_destroy(peri_cracks *c) {
    if (!c) return;
    const peri__memory memory = c->memory;
    peri__delete(&memory, c->start, c->path_capacity, sizeof *c->start);
    peri__delete(&memory, c->vertex, c->vertex_capacity, sizeof *c->vertex);
    peri__delete(&memory, c->time, c->time_capacity, sizeof *c->time);
    peri__delete(&memory, c->tip, c->tip_capacity, sizeof *c->tip);
    peri__delete(&memory, c, 1, sizeof *c);
}

static int32_t peri__check_cracks(peri_body *b, const peri_cracks_desc *d) {
    PERI_NEED(b, d, "desc");
    if (d->cookie != PERI_COOKIE_CRACKS) return peri__fail(b, PERI_ERROR_DESCRIPTOR, "desc", -1, 0.0);
    PERI_NEED_FLAG(b, d->initial);
    PERI_NEED_FLAG(b, d->current);
    if (!peri__is_nan(d->shortest)) PERI_NEED_NUMBER(b, d->shortest >= 0.0, d->shortest);
    return PERI_OK;
}

PERI_API int32_t peri_cracks_create(peri_body *b, const peri_cracks_desc *desc, peri_cracks **cracks) {
    if (cracks) *cracks = NULL;
    PERI_NEED_BUILT(b);
    PERI_NEED_WHOLE(b, "peri_cracks_create");
    PERI_NEED(b, cracks, "cracks");
    const int32_t status = peri__check_cracks(b, desc);
    if (status < 0) return status;
    peri_cracks_desc d = *desc;
    if (peri__is_nan(d.shortest)) d.shortest = b->desc.horizon;
    peri_cracks *c = (peri_cracks *)peri__new(&b->memory, 1, sizeof *c);
    if (c) {
        c->memory = b->memory;
        c->dim = b->dim;
        if (peri__grow(&c->memory, &c->start, &c->path_capacity, 1, sizeof *c->start)
            && (b->dim == 2 ? peri__find_paths(b, &d, c) : peri__find_patch(b, &d, c))) {
            *cracks = c;
            return PERI_OK;
        }
    }
    peri_cracks_destroy(c);
    return peri__fail(b, PERI_ERROR_MEMORY, "cracks", -1, 0.0);
}

PERI_API int64_t peri_cracks_paths(const peri_cracks *c) { return c ? c->paths : PERI_ERROR_ARGUMENT; }

PERI_API int64_t peri_cracks_vertices(const peri_cracks *c) { return c ? c->vertices : PERI_ERROR_ARGUMENT; }

PERI_API int64_t peri_cracks_tips(const peri_cracks *c) { return c ? c->tips : PERI_ERROR_ARGUMENT; }

PERI_API double peri_cracks_size(const peri_cracks *c) { return c ? c->size : 0.0; }

PERI_API int32_t peri_get_cracks(const peri_cracks *c, int64_t *start, double *vertex, double *time, peri_crack_tip *tip) {
    if (!c) return PERI_ERROR_ARGUMENT;
    if (start) memcpy(start, c->start, (size_t)(c->paths + 1) * sizeof *start);
    if (vertex && c->vertices > 0) memcpy(vertex, c->vertex, (size_t)(c->vertices * c->dim) * sizeof *vertex);
    if (time && c->vertices > 0) memcpy(time, c->time, (size_t)c->vertices * sizeof *time);
    if (tip && c->tips > 0) memcpy(tip, c->tip, (size_t)c->tips * sizeof *tip);
    return PERI_OK;
}

/* ---- VTP ---------------------------------------------------------------------------------------------------------- */

typedef struct peri__lines { /* text that a write callback takes line by line                                             */
    peri_write_fn write;
    void         *user;
    int32_t       failed;
} peri__lines;

static void peri__put_line(peri__lines *out, const char *line, const char *end) {
    if (!out->failed && out->write(out->user, line, end - line) != 0) out->failed = 1;
}

static void peri__put_tag(peri__lines *out, const char *tag) { peri__put_line(out, tag, tag + strlen(tag)); }

static void peri__put_piece(peri__lines *out, const peri_cracks *c) {
    char line[160];
    char *end = peri__put_integer(peri__put_text(line, "<Piece NumberOfPoints=\""), c->vertices);
    end = peri__put_integer(peri__put_text(end, "\" NumberOfLines=\""), c->dim == 2 ? c->paths : 0);
    end = peri__put_integer(peri__put_text(end, "\" NumberOfPolys=\""), c->dim == 3 ? c->paths : 0);
    end = peri__put_text(end, "\">\n<Points>\n");
    peri__put_line(out, line, end);
}

PERI_API int32_t peri_export_cracks_to(const peri_cracks *c, peri_write_fn write, void *user) {
    const char *cells = c && c->dim == 3 ? "Polys>\n" : "Lines>\n";
    char line[160], *end;
    if (!c || !write) return PERI_ERROR_ARGUMENT;
    peri__lines out = { write, user, 0 };
    peri__put_tag(&out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">\n<PolyData>\n");
    peri__put_piece(&out, c);
    peri__put_tag(&out, "<DataArray type=\"Float64\" Name=\"vertex\" NumberOfComponents=\"3\" format=\"ascii\">\n");
    for (int64_t n = 0; n < c->vertices; ++n) {
        end = line;
        for (int32_t d = 0; d < 3; ++d) end = peri__put_text(peri__put_double(end, d < c->dim ? c->vertex[n * c->dim + d] : 0.0), " ");
        peri__put_line(&out, line, peri__put_text(end, "\n"));
    }
    peri__put_tag(&out, "</DataArray>\n</Points>\n<PointData Scalars=\"time\">\n");
    peri__put_tag(&out, "<DataArray type=\"Float64\" Name=\"time\" NumberOfComponents=\"1\" format=\"ascii\">\n");
    for (int64_t n = 0; n < c->vertices; ++n) peri__put_line(&out, line, peri__put_text(peri__put_double(line, c->time[n]), "\n"));
    peri__put_tag(&out, "</DataArray>\n</PointData>\n<");
    peri__put_tag(&out, cells);
    peri__put_tag(&out, "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
    for (int64_t n = 0; n < c->vertices; ++n) peri__put_line(&out, line, peri__put_text(peri__put_integer(line, n), "\n"));
    peri__put_tag(&out, "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n");
    for (int64_t p = 1; p <= c->paths; ++p) peri__put_line(&out, line, peri__put_text(peri__put_integer(line, c->start[p]), "\n"));
    peri__put_tag(&out, "</DataArray>\n</");
    peri__put_tag(&out, cells);
    peri__put_tag(&out, "</Piece>\n</PolyData>\n</VTKFile>\n");
    return out.failed ? PERI_ERROR_WRITE : PERI_OK;
}
