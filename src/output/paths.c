/* SPDX-License-Identifier: MIT */
/* paths.c - the cracks of a body in 2D, as polylines.

   Pairs of adjacent points (sides.c) are the edges of a planar graph; its faces are the corners between cells. A pair
   whose bond is broken is a piece of crack from the face on its one side to that on the other, across the middle between the two points.
   So cracks are the dual graph, and what they are follows from how many pieces meet in a face: one is a tip, two go on, three branch. The
   outside and holes are open faces: there cracks end at a surface. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_HOLE 3.5   /* areas of a cell from which on a face is a hole: that of one missing cell has four              */
#define PERI_SMOOTH 4   /* passes of (1, 2, 1)/4 over the vertices of a path: steps of the lattice make it no longer      */

struct peri_cracks {
    peri__memory memory;
    int32_t      dim;
    int64_t      paths, path_capacity, vertices, vertex_capacity, time_capacity, tips, tip_capacity;
    int64_t     *start;  /* [paths+1]                                                                                    */
    double      *vertex; /* [vertices][dim]                                                                              */
    double      *time;   /* [vertices]                                                                                   */
    peri_crack_tip *tip; /* [tips]                                                                                       */
    double       size;   /* length, in 3D area                                                                           */
};

/* Half-edge h of side h/2 leaves the point end[h]; its left is face[h]. */
typedef struct peri__graph {
    peri_body    *body;
    const peri_cracks_desc *desc;
    peri_cracks  *out;
    int64_t       sides, faces, cracked;
    int32_t      *end;     /* [2*sides]                                                                                  */
    double       *time;    /* [sides] when it broke, NaN: not known; PERI_UNBROKEN                                       */
    int64_t      *start;   /* [points+1] half-edges that leave the points before                                         */
    int32_t      *leaving; /* [2*sides] half-edges by the point that they leave, counterclockwise                        */
    int32_t      *place;   /* [2*sides] where a half-edge is in `leaving`                                                */
    int32_t      *face;    /* [2*sides]                                                                                  */
    double       *centre;  /* [2*sides][2], of faces, like the next: mean of the corners                                 */
    uint8_t      *open;    /* [2*sides] 1: the outside, or a hole                                                        */
    int32_t      *degree;  /* [2*sides] cracked sides about it                                                           */
    int32_t      *link;    /* [2*sides][2] two of them, by the half-edge on its side                                     */
    int32_t      *spur;    /* [2*sides] the shortest path that ends there and at a tip: its first side, or -1; and       */
    double       *spur_length;
    int32_t      *trail;   /* [sides] half-edges of a path: the face that it comes from is on their left                 */
    uint8_t      *seen;    /* [sides]                                                                                    */
    double       *line;    /* [sides+2][2] vertices of a path                                                            */
    int32_t       failed;  /* 1: memory is short                                                                         */
} peri__graph;

/* Component d of where a point is, inner units. */
static double peri__place_at(const peri_body *b, int32_t current, int64_t i, int32_t d) {
    const int64_t at = d * b->model->stride + i;
    return peri__get_real(b->model->x, b->f32, at) + (current ? peri__get_real(b->u, b->f32, at) : 0.0);
}

/* When bond k of row i broke, the n-th of its sides; PERI_UNBROKEN where it counts as whole. */
static double peri__time_of_side(const peri_body *b, int32_t initial, int64_t i, int64_t k, int64_t n) {
    const int64_t word = i * b->model->words + k / 32;
    if (peri__is_alive(b, i, k) || (!initial && b->uncut && !(b->uncut[word] >> (k % 32) & 1))) return PERI_UNBROKEN;
    return b->side_time ? b->side_time[b->side_start[i] + n] : (double)NAN;
}

/* ---- the graph ---------------------------------------------------------------------------------------------------- */

static int peri__find_sides(peri__graph *g) {
    peri_body *b = g->body;
    const peri__model *m = b->model;
    peri__sorter s;
    peri__row row;
    int ok = 1;
    if (!peri__open_sorter(b, &s)) return 0;
    for (int filling = 0; ok && filling < 2; ++filling) {
        int64_t at = 0;
        for (int64_t i = 0; i < m->points; ++i) {
            peri__read_row(b, i, &row);
            const int64_t count = peri__upper_sides_of(b, i, &row, &s);
            for (int64_t n = 0; filling && n < count; ++n) {
                g->end[2 * (at + n)] = (int32_t)i;
                g->end[2 * (at + n) + 1] = row.ids[s.bond[n]];
                g->time[at + n] = peri__time_of_side(b, g->desc->initial, i, s.bond[n], n);
            }
            at += count;
        }
        g->sides = at;
        if (filling) break;
        g->end = (int32_t *)peri__new(&b->scratch, 2 * at, sizeof *g->end);
        g->time = (double *)peri__new(&b->scratch, at, sizeof *g->time);
        ok = g->end && g->time && at < INT32_MAX / 2;
    }
    peri__close_sorter(&s);
    return ok;
}

/* Does p lie before q, counterclockwise from the x axis? */
static int peri__turns_before(const double *p, const double *q) {
    const int lower_p = p[1] < 0.0 || (p[1] == 0.0 && p[0] < 0.0), lower_q = q[1] < 0.0 || (q[1] == 0.0 && q[0] < 0.0);
    return lower_p != lower_q ? lower_p < lower_q : p[0] * q[1] - p[1] * q[0] > 0.0;
}

static void peri__way_of(const peri__graph *g, int32_t half, double *xi) {
    double space[3];
    peri__bond_of(g->body->model, g->body->f32, g->end[half], g->end[half ^ 1], space);
    xi[0] = space[0];
    xi[1] = space[1];
}

/* Sorts the half-edges that leave each point. */
static void peri__sort_sides(peri__graph *g) {
    const int64_t points = g->body->model->points;
    for (int64_t h = 0; h < 2 * g->sides; ++h) g->start[g->end[h] + 1]++;
    for (int64_t i = 0; i < points; ++i) g->start[i + 1] += g->start[i];
    for (int64_t h = 0; h < 2 * g->sides; ++h) g->leaving[g->start[g->end[h]]++] = (int32_t)h;
    for (int64_t i = points; i > 0; --i) g->start[i] = g->start[i - 1];
    g->start[0] = 0;
    for (int64_t i = 0; i < points; ++i)
        for (int64_t n = g->start[i]; n < g->start[i + 1]; ++n) {
            const int32_t half = g->leaving[n];
            double xi[2], other[2];
            int64_t at = n;
            peri__way_of(g, half, xi);
            for (; at > g->start[i]; --at) {
                peri__way_of(g, g->leaving[at - 1], other);
                if (!peri__turns_before(xi, other)) break;
                g->leaving[at] = g->leaving[at - 1];
            }
            g->leaving[at] = half;
        }
    for (int64_t n = 0; n < 2 * g->sides; ++n) g->place[g->leaving[n]] = (int32_t)n;
}

/* The next half-edge around the face on the left. */
static int32_t peri__next_around(const peri__graph *g, int32_t half) {
    const int64_t i = g->end[half ^ 1], at = g->place[half ^ 1];
    return g->leaving[at > g->start[i] ? at - 1 : g->start[i + 1] - 1];
}

/* Numbers the faces. */
static void peri__find_faces(peri__graph *g) {
    const peri__model *m = g->body->model;
    for (int64_t h = 0; h < 2 * g->sides; ++h) g->face[h] = -1;
    for (int64_t first = 0; first < 2 * g->sides; ++first) {
        double area = 0.0, cells = 0.0, *centre = &g->centre[2 * g->faces], corners = 0.0, origin[2] = { 0.0, 0.0 };
        int32_t half = (int32_t)first;
        if (g->face[first] >= 0) continue;
        for (int d = 0; d < 2; ++d) origin[d] = peri__place_at(g->body, 0, g->end[first], d);
        do {
            double xi[2];
            const int64_t i = g->end[half];
            peri__way_of(g, half, xi);
            area += 0.5 * ((peri__place_at(g->body, 0, i, 0) - origin[0]) * xi[1] - (peri__place_at(g->body, 0, i, 1) - origin[1]) * xi[0]);
            for (int d = 0; d < 2; ++d) centre[d] += peri__place_at(g->body, g->desc->current, i, d);
            cells += m->volume[i];
            corners += 1.0;
            g->face[half] = (int32_t)g->faces;
            half = peri__next_around(g, half);
        } while (half != first);
        for (int d = 0; d < 2; ++d) centre[d] /= corners;
        g->open[g->faces++] = !(area > 0.0 && area < PERI_HOLE * cells / corners);
    }
}

static int peri__is_bridge(const peri__graph *g, int64_t side) { return g->face[2 * side] == g->face[2 * side + 1]; }

/* What meets in each face. */
static void peri__count_pieces(peri__graph *g) {
    memset(g->degree, 0, (size_t)g->faces * sizeof *g->degree);
    for (int64_t h = 0; h < 2 * g->sides; ++h) {
        const int32_t f = g->face[h];
        if (g->time[h / 2] == PERI_UNBROKEN || peri__is_bridge(g, h / 2)) continue;
        if (g->degree[f] < 2) g->link[2 * f + g->degree[f]] = (int32_t)h;
        g->degree[f]++;
    }
}

/* ---- paths -------------------------------------------------------------------------------------------------------- */

/* Does a path end at the face on the left of a half-edge? */
static int peri__ends_at(const peri__graph *g, int32_t half) {
    return g->open[g->face[half]] || g->degree[g->face[half]] != 2 || peri__is_bridge(g, half / 2);
}

static int peri__is_tip(const peri__graph *g, int32_t half) {
    return !g->open[g->face[half]] && g->degree[g->face[half]] == 1 && !peri__is_bridge(g, half / 2);
}

/* From a half-edge on, to the end or around. Returns how many sides. */
static int64_t peri__trace(peri__graph *g, int32_t half) {
    int64_t count = 0;
    for (;;) {
        g->trail[count++] = half;
        g->seen[half / 2] = 1;
        if (peri__ends_at(g, half ^ 1)) return count;
        const int32_t *link = &g->link[2 * g->face[half ^ 1]];
        half = link[0] == (half ^ 1) ? link[1] : link[0];
        if (g->seen[half / 2]) return count;
    }
}

/* Where a path ends: in the middle of a corner, or half a cell beyond the last points. */
static void peri__end_of(const peri__graph *g, int32_t half, const double *middle, double *end) {
    double xi[2];
    peri__way_of(g, half, xi);
    for (int d = 0; d < 2; ++d) {
        if (!g->open[g->face[half]] && !peri__is_bridge(g, half / 2)) end[d] = g->centre[2 * g->face[half] + d];
        else if (!g->open[g->face[half ^ 1]] && !peri__is_bridge(g, half / 2))
            end[d] = 2.0 * middle[d] - g->centre[2 * g->face[half ^ 1] + d];
        else end[d] = middle[d] + 0.5 * (d == 0 ? -xi[1] : xi[0]);
    }
}

/* The vertices of the trail to g->line; returns their number. loop: the first is the last, too. */
static int64_t peri__draw_path(const peri__graph *g, int64_t count, int loop) {
    double *line = g->line, before[2];
    const int64_t all = count + (loop ? 1 : 2), from = loop ? 0 : 1;
    for (int64_t n = 0; n < count; ++n)
        for (int d = 0; d < 2; ++d)
            line[2 * (n + from) + d] = 0.5 * (peri__place_at(g->body, g->desc->current, g->end[g->trail[n]], d)
                                              + peri__place_at(g->body, g->desc->current, g->end[g->trail[n] ^ 1], d));
    if (loop) memcpy(&line[2 * count], line, 2 * sizeof *line);
    else {
        peri__end_of(g, g->trail[0], &line[2], line);
        peri__end_of(g, g->trail[count - 1] ^ 1, &line[2 * count], &line[2 * (count + 1)]);
    }
    for (int pass = 0; pass < PERI_SMOOTH; ++pass) {
        memcpy(before, line, sizeof before);
        for (int64_t n = 1; n + 1 < all; ++n)
            for (int d = 0; d < 2; ++d) {
                const double own = line[2 * n + d];
                line[2 * n + d] = 0.25 * (before[d] + 2.0 * own + line[2 * n + 2 + d]);
                before[d] = own;
            }
    }
    return all;
}

static double peri__length_of(const double *line, int64_t count) {
    double sum = 0.0;
    for (int64_t n = 1; n < count; ++n)
        sum += sqrt(peri__square(line[2 * n] - line[2 * n - 2]) + peri__square(line[2 * n + 1] - line[2 * n - 1]));
    return sum;
}

typedef void (*peri__path_fn)(peri__graph *g, int64_t count, int loop);

/* Calls fn for each path: those with ends, by the least side, then those that go around. */
static void peri__each_path(peri__graph *g, peri__path_fn fn) {
    memset(g->seen, 0, (size_t)g->sides);
    for (int loop = 0; loop < 2; ++loop)
        for (int64_t h = 0; h < 2 * g->sides; ++h) {
            if (g->time[h / 2] == PERI_UNBROKEN || g->seen[h / 2] || (!loop && !peri__ends_at(g, (int32_t)h))) continue;
            fn(g, peri__trace(g, (int32_t)h), loop);
        }
}

/* Takes a path out. */
static void peri__mend_path(peri__graph *g, int64_t count) {
    for (int64_t n = 0; n < count; ++n) g->time[g->trail[n] / 2] = PERI_UNBROKEN;
    g->cracked -= count;
}

/* Notes the shortest spur of each branching, and takes out what is short and ends at no branching. */
static void peri__find_spur(peri__graph *g, int64_t count, int loop) {
    const int32_t ends[2] = { g->trail[0], g->trail[count - 1] ^ 1 };
    const double length = loop ? HUGE_VAL : peri__length_of(g->line, peri__draw_path(g, count, loop)) * g->body->model->length;
    if (!(length < g->desc->shortest) || (!peri__is_tip(g, ends[0]) && !peri__is_tip(g, ends[1]))) return;
    const int32_t f = g->face[peri__is_tip(g, ends[0]) ? ends[1] : ends[0]];
    if (g->open[f] || g->degree[f] < 3) {
        peri__mend_path(g, count);
        return;
    }
    if (g->spur[f] >= 0 && !(length < g->spur_length[f])) return;
    g->spur[f] = ends[0];
    g->spur_length[f] = length;
}

/* Takes out the shortest spur of each branching, until none is left. */
static void peri__prune(peri__graph *g) {
    for (int64_t before = -1; before != g->cracked;) {
        before = g->cracked;
        for (int64_t f = 0; f < g->faces; ++f) g->spur[f] = -1;
        peri__each_path(g, peri__find_spur);
        memset(g->seen, 0, (size_t)g->sides);
        for (int64_t f = 0; f < g->faces; ++f)
            if (g->spur[f] >= 0 && !g->seen[g->spur[f] / 2]) peri__mend_path(g, peri__trace(g, g->spur[f]));
        peri__count_pieces(g);
    }
}

/* ---- what is found ------------------------------------------------------------------------------------------------ */

/* Adds a path of `count` vertices, inner units, times to be filled in; returns the first. -1 where memory is short. */
static int64_t peri__add_path(const peri_body *b, peri_cracks *c, const double *line, int64_t count) {
    const int64_t first = c->vertices;
    if (!peri__grow(&c->memory, &c->start, &c->path_capacity, c->paths + 2, sizeof *c->start)
        || !peri__grow(&c->memory, &c->vertex, &c->vertex_capacity, (first + count) * c->dim, sizeof *c->vertex)
        || !peri__grow(&c->memory, &c->time, &c->time_capacity, first + count, sizeof *c->time))
        return -1;
    for (int64_t n = 0; n < count; ++n)
        for (int32_t d = 0; d < c->dim; ++d)
            c->vertex[(first + n) * c->dim + d] = b->model->origin[d] + b->model->length * line[n * c->dim + d];
    c->vertices += count;
    c->start[++c->paths] = c->vertices;
    return first;
}

/* The tip at the end of the last path; back: at its first vertex. Speed: least squares of arc length over time, within two horizons. */
static void peri__add_tip(peri__graph *g, int back) {
    peri_cracks *c = g->out;
    const int64_t first = c->start[c->paths - 1], last = c->vertices - 1, step = back ? 1 : -1, end = back ? first : last;
    const double horizon = g->body->desc.horizon, *tip = &c->vertex[2 * end];
    double arc = 0.0, count = 0.0, sum[4] = { 0.0, 0.0, 0.0, 0.0 }, zero = 0.0;
    if (!peri__grow(&c->memory, &c->tip, &c->tip_capacity, c->tips + 1, sizeof *c->tip)) {
        g->failed = 1;
        return;
    }
    peri_crack_tip *t = &c->tip[c->tips++];
    memset(t, 0, sizeof *t);
    t->path = c->paths - 1;
    for (int64_t n = end + step; n >= first && n <= last && arc < 2.0 * horizon; n += step) {
        const double *at = &c->vertex[2 * n], way[2] = { tip[0] - at[0], tip[1] - at[1] };
        arc += sqrt(peri__square(at[0] - at[-2 * step]) + peri__square(at[1] - at[1 - 2 * step]));
        if (arc <= horizon || n == end + step) (void)peri__direction(way, 2, t->direction);
        if (!peri__finite(c->time[n]) || n == first || n == last) continue; /* ends have the time of the next */
        if (count == 0.0) zero = c->time[n];
        const double time = c->time[n] - zero;
        count += 1.0;
        sum[0] += time;
        sum[1] -= arc;
        sum[2] += time * time;
        sum[3] -= time * arc;
    }
    const double spread = count * sum[2] - sum[0] * sum[0];
    t->speed = count >= 3.0 && spread > 1e-12 * count * sum[2] ? (count * sum[3] - sum[0] * sum[1]) / spread : (double)NAN;
    for (int d = 0; d < 2; ++d) t->place[d] = tip[d];
}

static void peri__keep_path(peri__graph *g, int64_t count, int loop) {
    peri_cracks *c = g->out;
    const int64_t all = peri__draw_path(g, count, loop), first = peri__add_path(g->body, c, g->line, all);
    if (first < 0) {
        g->failed = 1;
        return;
    }
    for (int64_t n = 0; n < all; ++n) {
        const int64_t side = loop ? n % count : n == 0 ? 0 : n > count ? count - 1 : n - 1;
        c->time[first + n] = g->time[g->trail[side] / 2];
    }
    c->size += peri__length_of(g->line, all) * g->body->model->length;
    if (!loop && peri__is_tip(g, g->trail[0])) peri__add_tip(g, 1);
    if (!loop && peri__is_tip(g, g->trail[count - 1] ^ 1)) peri__add_tip(g, 0);
}

#define PERI_GRAPH_ARRAYS(X, g, points)                                                                                \
    X(g, start, (points) + 1) X(g, leaving, 2 * (g)->sides) X(g, place, 2 * (g)->sides) X(g, face, 2 * (g)->sides)    \
    X(g, centre, 4 * (g)->sides) X(g, open, 2 * (g)->sides) X(g, degree, 2 * (g)->sides) X(g, link, 4 * (g)->sides)   \
    X(g, spur, 2 * (g)->sides) X(g, spur_length, 2 * (g)->sides) X(g, trail, (g)->sides) X(g, seen, (g)->sides)       \
    X(g, line, 2 * (g)->sides + 4)

/* The paths of a body in 2D. 0 where memory is short. */
static int peri__find_paths(peri_body *b, const peri_cracks_desc *desc, peri_cracks *out) {
    const int64_t points = b->model->points;
    peri__graph g;
    memset(&g, 0, sizeof g);
    g.body = b;
    g.desc = desc;
    g.out = out;
    int ok = peri__find_sides(&g);
#define PERI_TAKE_(g, member, count)                                                                                   \
    if (ok) {                                                                                                          \
        void *taken_ = peri__new(&b->scratch, count, sizeof *(g)->member);                                             \
        memcpy(&(g)->member, &taken_, sizeof taken_);                                                                  \
        ok = taken_ != NULL;                                                                                           \
    }
    PERI_GRAPH_ARRAYS(PERI_TAKE_, &g, points)
#undef PERI_TAKE_
    if (ok) {
        peri__sort_sides(&g);
        peri__find_faces(&g);
        for (int64_t s = 0; s < g.sides; ++s) g.cracked += g.time[s] != PERI_UNBROKEN;
        peri__count_pieces(&g);
        peri__prune(&g);
        peri__each_path(&g, peri__keep_path);
        ok = !g.failed;
    }
#define PERI_GIVE_(g, member, count) peri__delete(&b->scratch, (g)->member, count, sizeof *(g)->member);
    PERI_GRAPH_ARRAYS(PERI_GIVE_, &g, points)
#undef PERI_GIVE_
    peri__delete(&b->scratch, g.end, 2 * g.sides, sizeof *g.end);
    peri__delete(&b->scratch, g.time, g.sides, sizeof *g.time);
    return ok;
}
