/* SPDX-License-Identifier: MIT */
/* span.c - do points span the space?

   The constants are for families that fill a ball. A row of points, or a sheet one cell thick in 3D, has a few of its bonds, and answers
   with 3.5 or 0.16 times the stiffness asked for, whatever the law. Such families are flat: along their least direction the bonds reach
   less far, root mean square, than a part of the way to the nearest neighbour, a little bent or not. Of two layers of a lattice with bonds
   to the nearest neighbours alone it is 0.45 of that way, of a corner of a cube 0.58.

   They are built, since a chain of springs is what some ask for, with a remark in the log. A part within one family is no row yet, and
   has no bulk whose stiffness could be wrong. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_FLAT 0.4 /* root of the least eigenvalue of the mean of xi xi, over the way to the nearest neighbour          */

typedef struct peri__spans {
    const peri__model *model;
    uint8_t           *spans; /* [points] 1: the family spans the space, 0: it is flat                                  */
} peri__spans;

/* Is the least eigenvalue of a symmetric matrix above t? By the leading minors of a - t. */
static int peri__is_above(int32_t dim, const double *a, double t) {
    const double xx = a[0] - t, yy = a[1] - t, zz = dim == 3 ? a[2] - t : 1.0, xy = a[dim == 3 ? 3 : 2];
    const double yz = dim == 3 ? a[4] : 0.0, xz = dim == 3 ? a[5] : 0.0, minor = xx * yy - xy * xy;
    return xx > 0.0 && minor > 0.0 && zz * minor + (xy * yz - yy * xz) * xz + (xy * xz - xx * yz) * yz > 0.0;
}

static int peri__spans_space(const peri__model *m, int64_t i, const peri__row *row) {
    double square[6] = { 0.0 }, nearest = HUGE_VAL;
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3], bond;
        peri__bond_of(m, m->f32, i, row->ids[k], xi);
        bond = peri__dot(xi, xi, m->dim);
        if (bond < nearest) nearest = bond;
        for (int a = 0; a < m->dim; ++a)
            for (int c = a; c < m->dim; ++c) square[peri__packed(m->dim, a, c)] += xi[a] * xi[c];
    }
    return peri__is_above(m->dim, square, PERI_FLAT * PERI_FLAT * nearest * (double)row->count);
}

/* sums->n: points that are flat. */
static void peri__spans_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__spans *s = (const peri__spans *)context;
    peri__row row;
    for (int64_t i = begin; i < end; ++i) {
        if (s->spans[i]) continue;
        peri__row_of(s->model, i, &row);
        s->spans[i] = (uint8_t)peri__spans_space(s->model, i, &row);
        sums->n += !s->spans[i];
    }
}

/* Points of lattices with more of a ball than a sheet has need no look. */
static void peri__pass_whole_families(const peri_body *b, uint8_t *spans) {
    const peri__model *m = b->model;
    const double ball = m->dim == 3 ? 4.0 / 3.0 * PERI_PI * m->horizon * m->horizon * m->horizon : PERI_PI * m->horizon * m->horizon;
    for (int64_t p = 0; p < b->setup.piece_count; ++p) {
        const peri__piece *piece = &b->setup.pieces[p];
        for (int64_t i = piece->first; piece->lattice && i < piece->first + piece->count; ++i)
            if (m->count[i] > 1 << m->dim && m->count[i] * m->volume[i] > 0.6 * ball) spans[i] = 1;
    }
}

typedef struct peri__part { /* of a connected part, kept at its first point                                              */
    int32_t parent, points, most; /* most: the largest family                                                            */
} peri__part;

static int64_t peri__first_of_part(peri__part *part, int64_t i) {
    while (part[i].parent != i) i = part[i].parent = part[part[i].parent].parent;
    return i;
}

/* The first flat point of a part that is larger than a family, or -1. */
static int64_t peri__find_flat(const peri__spans *s, peri__part *part) {
    const peri__model *m = s->model;
    peri__row row;
    for (int64_t i = 0; i < m->points; ++i) part[i].parent = (int32_t)i;
    for (int64_t i = 0; i < m->points; ++i) {
        peri__row_of(m, i, &row);
        for (int64_t k = 0; k < row.count; ++k) {
            const int64_t p = peri__first_of_part(part, i), q = peri__first_of_part(part, row.ids[k]);
            part[p > q ? p : q].parent = (int32_t)(p > q ? q : p);
        }
    }
    for (int64_t i = 0; i < m->points; ++i) {
        peri__part *p = &part[peri__first_of_part(part, i)];
        p->points++;
        if (m->count[i] > p->most) p->most = m->count[i];
    }
    for (int64_t i = 0; i < m->points; ++i) {
        const peri__part *p = &part[peri__first_of_part(part, i)];
        if (!s->spans[i] && p->points > p->most + 1) return i;
    }
    return -1;
}

static void peri__remark_flat(peri_body *b, int64_t point) {
    char text[160];
    char *end = peri__put_text(text, "rows of points, or sheets one cell thick, first at point ");
    (void)strcpy(peri__put_integer(end, point), ": stiffness there is off by a factor, since the constants are of the space");
    peri__log(b, 1, text);
}

/* Warns of rows and sheets of points. Nothing is looked at where nobody listens. sums: of all blocks. */
static int32_t peri__check_span(peri_body *b, peri__sums *sums) {
    const peri__model *m = b->model;
    peri__spans s;
    if (!b->desc.log) return PERI_OK;
    s.model = m;
    s.spans = (uint8_t *)peri__new(&b->scratch, m->points, 1);
    if (!s.spans) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    peri__pass_whole_families(b, s.spans);
    peri__for_points(b, m->points, 4 * m->width, peri__spans_block, &s, sums);
    const int64_t count = peri__total(sums, m->points).n;
    peri__part *part = count > 0 ? (peri__part *)peri__new(&b->scratch, m->points, sizeof *part) : NULL;
    const int64_t flat = part ? peri__find_flat(&s, part) : -1;
    peri__delete(&b->scratch, s.spans, m->points, 1);
    peri__delete(&b->scratch, part, m->points, sizeof *part);
    if (count > 0 && !part) return peri__fail(b, PERI_ERROR_MEMORY, "families", -1, 0.0);
    if (flat >= 0) peri__remark_flat(b, flat);
    return PERI_OK;
}
