/* SPDX-License-Identifier: MIT */
/* strain.c - dilatation, strain and stress of points, from the displacements of their live families ([T] 4.10-4.14). */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* A field of point i, inner units, to out[components]. */
typedef void (*peri__point_fn)(const peri_body *b, int64_t i, const peri__row *row, double *out, peri__sums *sums);

typedef struct peri__gradients {
    const peri_body *body;
    peri__point_fn   at;
    int32_t          components;
    double          *out; /* [points*components]                                                                         */
} peri__gradients;

/* H = F - 1 of a point on what its live bonds span, and the projector P onto that. A rotation R of a thin family has H = (R - 1) P, so
   strain is P E P: zero for rotations, and E itself where the space is spanned. */
typedef struct peri__deformation {
    double h[3][3], p[3][3];
    int    whole; /* the live bonds span the space                                                                       */
} peri__deformation;

/* theta of the law: sum w g e V, in units of what it is where e = |xi|; of the extension beyond the stretch `less`. A point of a pairwise
   law counts as one of LPS with w/|xi| in place of w. */
static double peri__dilatation(const peri_body *b, int64_t i, const peri__row *row, double less) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    const int live = law->pairwise || peri__counts_live(b, law);
    double sum = 0.0, whole = 0.0;
    for (int64_t k = 0; k < row->count; ++k) {
        double w = peri__weight_of(m, i, row->weight, k), bond = peri__get_real(row->bond, b->b32, k);
        const int alive = peri__is_alive(b, i, k);
        if (law->gauge) w *= bond;
        if (alive) sum += w * bond * (peri__stretch(b, i, row, k) - less);
        if (alive || !live) whole += w * bond;
    }
    return whole > 0.0 ? m->dim * sum / whole : 0.0;
}

static void peri__deform(const peri_body *b, int64_t i, const peri__row *row, peri__deformation *f) {
    const peri__model *m = b->model;
    double n[3][3] = { { 0.0 } }, shape[6] = { 0.0 }, inverse[6];
    for (int64_t k = 0; k < row->count; ++k) {
        double xi[3], eta[3], w = peri__weight_of(m, i, row->weight, k);
        if (!peri__is_alive(b, i, k)) continue;
        peri__pull_of(b, i, row->ids[k], xi, eta);
        for (int a = 0; a < m->dim; ++a)
            for (int c = 0; c < m->dim; ++c) {
                n[a][c] += w * eta[a] * xi[c];
                if (c >= a) shape[peri__packed(m->dim, a, c)] += w * xi[a] * xi[c];
            }
    }
    f->whole = peri__invert(m->dim, shape, PERI_SPAN, inverse) == m->dim;
    for (int a = 0; a < m->dim; ++a)
        for (int c = 0; c < m->dim; ++c) {
            f->h[a][c] = f->p[a][c] = 0.0;
            for (int d = 0; d < m->dim; ++d) {
                f->h[a][c] += n[a][d] * inverse[peri__packed(m->dim, d, c)];
                f->p[a][c] += shape[peri__packed(m->dim, a, d)] * inverse[peri__packed(m->dim, d, c)];
            }
        }
}

static void peri__strain_of(const peri_body *b, const peri__deformation *f, double strain[3][3]) {
    double e[3][3], h[3][3];
    memcpy(h, f->h, sizeof h);
    peri__strain(b->dim, b->desc.geometry == PERI_GEOMETRY_LINEAR, h, e);
    for (int a = 0; a < b->dim; ++a)
        for (int c = 0; c < b->dim; ++c) {
            strain[a][c] = f->whole ? e[a][c] : 0.0;
            for (int k = 0; !f->whole && k < b->dim; ++k)
                for (int l = 0; l < b->dim; ++l) strain[a][c] += f->p[a][k] * e[k][l] * f->p[l][c];
        }
}

/* The strain that bears force: see make_elastic of rows.inl. */
static void peri__elastic_strain_of(const peri_body *b, int64_t i, const peri__deformation *f, double strain[3][3]) {
    const double own = peri__eigenstrain_at(b, i), grown = b->desc.geometry == PERI_GEOMETRY_LINEAR ? own : own + 0.5 * own * own;
    peri__strain_of(b, f, strain);
    for (int a = 0; grown != 0.0 && a < b->dim; ++a)
        for (int c = 0; c < b->dim; ++c) strain[a][c] -= grown * (f->whole ? a == c : f->p[a][c]);
}

static double peri__det(double f[3][3]) {
    return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0])
         + f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

/* Cauchy stress of the first Piola-Kirchhoff stress p: p F^T/det F; p itself where the geometry is linear. Symmetric part, packed. Where
   the space is not spanned the volume is that of the strain, sqrt(det(1 + 2 E)). */
static void peri__cauchy(const peri_body *b, double p[3][3], const peri__deformation *deformation, double *out) {
    double sigma[3][3], f[3][3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } }, volume = 1.0, strain[3][3];
    int dim = b->dim, linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    if (!linear && !deformation->whole) {
        peri__strain_of(b, deformation, strain);
        for (int a = 0; a < dim; ++a)
            for (int c = 0; c < dim; ++c) f[a][c] += 2.0 * strain[a][c];
        volume = sqrt(fabs(peri__det(f)));
    }
    for (int a = 0; !linear && a < dim; ++a)
        for (int c = 0; c < dim; ++c) f[a][c] = (a == c ? 1.0 : 0.0) + deformation->h[a][c];
    if (!linear && deformation->whole) volume = peri__det(f);
    if (!(fabs(volume) > 1e-12)) volume = 1e-12; /* a family pressed flat has no Cauchy stress; a large one is shown */
    for (int a = 0; a < dim; ++a)
        for (int c = 0; c < dim; ++c) {
            sigma[a][c] = 0.0;
            for (int d = 0; d < dim; ++d) sigma[a][c] += p[a][d] * f[c][d] / volume;
        }
    for (int a = 0; a < dim; ++a)
        for (int c = a; c < dim; ++c) out[peri__packed(dim, a, c)] = 0.5 * (sigma[a][c] + sigma[c][a]);
}

/* P as the caller has it; NaN where the caller fails: sums->bad, n. */
static void peri__own_piola(const peri_body *b, int64_t i, const peri__deformation *f, double p[3][3], peri__sums *sums) {
    peri__operands operands;
    const peri__own own = { b, &operands, NULL, NULL, NULL };
    peri__own_run run;
    peri__sums asked = { 0.0, 0.0, 0, -1 };
    memset(&operands, 0, sizeof operands);
    run.first = i;
    run.count = 1;
    for (int a = 0; a < b->dim; ++a) memcpy(&run.gradient[a * b->dim], f->h[a], (size_t)b->dim * sizeof(double));
    peri__ask_stress(&own, &run, NULL, &asked);
    for (int a = 0; a < b->dim; ++a)
        for (int d = 0; d < b->dim; ++d) p[a][d] = asked.bad < 0 ? run.stress[a * b->dim + d] / b->model->stress : (double)NAN;
    if (asked.bad >= 0 && sums->bad < 0) *sums = asked;
}

/* P of the strain where the law has a gradient; of others as Hooke's law has it. */
static void peri__piola(const peri_body *b, int64_t i, const peri__deformation *f, double p[3][3], peri__sums *sums) {
    peri__law room;
    const peri__law *law = peri__law_at(b, i, &room);
    double s[3][3], h[3][3];
    if (b->model->past.raw[b->model->material[i]]) {
        peri__own_piola(b, i, f, p, sums);
        return;
    }
    memcpy(h, f->h, sizeof h);
    peri__elastic_strain_of(b, i, f, s);
    peri__stress(law, b->dim, b->desc.geometry == PERI_GEOMETRY_LINEAR, h, s, p);
}

/* sum T xi V over the live bonds, T the half that point i gives. sums->bad: a law of bonds, or the caller, failed. */
static void peri__collapsed_stress(const peri_body *b, int64_t i, const peri__row *row, const peri__deformation *f, double p[3][3],
                                   peri__sums *sums) {
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    int linear = b->desc.geometry == PERI_GEOMETRY_LINEAR;
    double inverse[6] = { 0.0 }, pressure_factor = 0.0, stabilization = 0.0, stress[3][3];
    double slope;
    peri__bunch bunch;
    int tensor = 0;
    bunch.point = -1;
    bunch.failed = bunch.asked = 0;
    if (!law->pairwise) pressure_factor = peri__get_constant(b, i, PERI__PRESSURE_FACTOR);
    if (pressure_factor != 0.0) pressure_factor *= peri__dilatation(b, i, row, peri__eigenstrain_at(b, i));
    if (law->gather & PERI__GRADIENT) {
        stabilization = peri__get_constant(b, i, PERI__STABILIZATION);
        for (int k = 0; k < PERI_PACKED(m->dim); ++k) inverse[k] = peri__get_constant(b, i, PERI__SHAPE_INVERSE + k);
        tensor = inverse[0] != 0.0;
        peri__piola(b, i, f, stress, sums);
    }
    for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c) p[a][c] = 0.0;
    for (int64_t k = 0; k < row->count; ++k) {
        int64_t at = row->first + k;
        double xi[3], eta[3], t[3] = { 0.0, 0.0, 0.0 }, length = 0.0, central;
        double w = peri__weight_of(m, i, row->weight, k), bond = peri__get_real(row->bond, b->b32, k), e;
        if (!peri__is_alive(b, i, k)) continue;
        peri__pull_of(b, i, row->ids[k], xi, eta);
        if (m->centroid)
            for (int d = 0; d < m->dim; ++d) xi[d] = peri__get_real(m->centroid, b->b32, at * m->dim + d);
        peri__ask_bond(b, i, row, k, &bunch, &e, &slope);
        e *= bond;
        for (int d = 0; d < m->dim; ++d) length += peri__square(xi[d] + (linear ? 0.0 : eta[d]));
        length = sqrt(length) + DBL_MIN;
        if (b->past.flow) e -= b->past.flow[b->past.start[i] + k];
        central = pressure_factor * peri__law_gauge(law, bond) + peri__spring(b, i, row->ids[k], bond) * e;
        for (int d = 0; d < m->dim; ++d) {
            t[d] = central * (xi[d] + (linear ? 0.0 : eta[d])) / length + stabilization * eta[d];
            for (int a = 0; tensor && a < m->dim; ++a) {
                t[d] -= stabilization * f->h[d][a] * xi[a];
                for (int c = 0; c < m->dim; ++c) t[d] += stress[d][a] * inverse[peri__packed(m->dim, a, c)] * xi[c];
            }
            for (int a = 0; a < m->dim; ++a) p[d][a] += w * t[d] * xi[a];
        }
    }
    if (bunch.failed && sums->bad < 0) sums->bad = i;
}

static void peri__family_dilatation(const peri_body *b, int64_t i, const peri__row *row, double *out, peri__sums *sums) {
    const peri__model *m = b->model;
    peri__deformation f;
    double strain[3][3];
    (void)sums;
    *out = 0.0;
    if (!(m->laws[m->material[i]].gather & PERI__GRADIENT)) {
        *out = peri__dilatation(b, i, row, 0.0);
        return;
    }
    peri__deform(b, i, row, &f);
    peri__strain_of(b, &f, strain);
    for (int a = 0; a < m->dim; ++a) *out += strain[a][a];
}

static void peri__family_strain(const peri_body *b, int64_t i, const peri__row *row, double *out, peri__sums *sums) {
    peri__deformation f;
    double strain[3][3];
    (void)sums;
    peri__deform(b, i, row, &f);
    peri__strain_of(b, &f, strain);
    for (int a = 0; a < b->dim; ++a)
        for (int c = a; c < b->dim; ++c) out[peri__packed(b->dim, a, c)] = strain[a][c];
}

/* F = 1 + H, by rows: in directions that the live bonds do not span nothing is deformed. */
static void peri__family_deformation_gradient(const peri_body *b, int64_t i, const peri__row *row, double *out, peri__sums *sums) {
    peri__deformation f;
    (void)sums;
    peri__deform(b, i, row, &f);
    for (int a = 0; a < b->dim; ++a)
        for (int c = 0; c < b->dim; ++c) out[a * b->dim + c] = f.h[a][c] + (a == c ? 1.0 : 0.0);
}

static void peri__family_stress(const peri_body *b, int64_t i, const peri__row *row, double *out, peri__sums *sums) {
    peri__deformation f;
    double p[3][3];
    peri__deform(b, i, row, &f);
    if (b->past.flow && peri__flowing(b, i)) peri__collapsed_stress(b, i, row, &f, p, sums);
    else peri__piola(b, i, &f, p, sums);
    peri__cauchy(b, p, &f, out);
}

static void peri__family_force_stress(const peri_body *b, int64_t i, const peri__row *row, double *out, peri__sums *sums) {
    peri__deformation f;
    double p[3][3];
    peri__deform(b, i, row, &f);
    peri__collapsed_stress(b, i, row, &f, p, sums);
    peri__cauchy(b, p, &f, out);
}

static void peri__gradients_block(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__gradients *g = (const peri__gradients *)context;
    peri__row row;
    for (int64_t i = begin; i < end; ++i) {
        peri__read_row(g->body, i, &row);
        g->at(g->body, i, &row, &g->out[i * g->components], sums);
    }
}

/* Notes what of the caller failed in the last pass over points, for peri__heed_laws: a stress, sums->n, or else a law of bonds. */
static void peri__note_failures(peri_body *b) {
    int64_t k = 0;
    while (k < b->model->blocks && b->sums[k].bad < 0) k++;
    if (k == b->model->blocks) return;
    if (b->sums[k].n != 0) peri__note_stress(b, b->sums);
    else peri__note_laws(b);
}

/* What such fields are made of, brought up to date. */
static void peri__ready_gradients(peri_body *b) {
    (void)peri__ensure(b, PERI__STALE_CONSTANTS);
    if (b->model->inelastic & PERI__FLOWS) (void)peri__make_flow(b, b->u, 0.0, 0, NULL);
}

static void peri__read_gradients(peri_body *b, peri__point_fn at, int32_t components, double *out) {
    peri__gradients gradients = { b, at, components, out };
    peri__ready_gradients(b);
    const int32_t former = peri__enter(b, PERI__IN_CALLBACK);
    peri__for_points(b, b->model->points, 8 * b->model->width, peri__gradients_block, &gradients, b->sums);
    peri__leave(b, former);
    peri__note_failures(b);
}
