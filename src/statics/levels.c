/* SPDX-License-Identifier: MIT */
/* levels.c - levels of nodes with sparse stiffness, each coarser than the one before: products, smoothing, a V-cycle.

   Nodes lie at the sites of a regular grid. Where a body is cut through at a site there are more nodes than one at it, each for the side
   that it belongs to, so that a level can open a crack as the points do. A site without points has none. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_LEVELS    24
#define PERI_DENSE     200  /* no level is made below one with so few unknowns,                                           */
#define PERI_DENSE_MOST 1000 /* and none with more is solved directly                                                     */
#define PERI_LEVELS_WORTH 12.0 /* iterations that it takes as long as to make the levels                                  */
#define PERI_SMOOTHING 3    /* degree of the polynomials                                                                  */
#define PERI_SMOOTHED  10.0 /* they cover the eigenvalues above the largest over this                                     */

typedef struct peri__shares { /* sparse: row k has the entries start[k] to start[k+1]                                     */
    int64_t  rows, entries;
    int64_t *start;
    int32_t *node;
    float   *weight;
} peri__shares;

typedef struct peri__mesh_level {
    int64_t  sites[3], site_count, count, entries; /* count: nodes                                                        */
    int64_t *first;   /* [site_count+1] nodes of the sites before                                                         */
    int64_t *start;   /* [count+1] rows of the stiffness                                                                  */
    int32_t *column;  /* [entries] ascending                                                                              */
    float   *block;   /* [entries][dim][dim]                                                                              */
    float   *inverse; /* [count][dim][dim] of the diagonal                                                                */
    double  *x, *r, *step, *product; /* [count*dim]                                                                       */
    double   largest; /* eigenvalue of inverse*block                                                                      */
    peri__shares up, down; /* what each node takes of those of the next level, and what of this each of those gives       */
} peri__mesh_level;

struct peri__multilevel {
    peri__memory memory;
    int32_t  dim, levels;
    double   origin[3], spacing;
    int64_t  cells[3], cell_count, points;
    int64_t  patches; /* connected points of a cell                                                                       */
    int32_t *start;   /* [patches+1] first place in order                                                                 */
    int32_t *order;   /* [points] by patches                                                                              */
    int32_t *node;    /* [patches][2^dim] of the finest level, at the corners of the cell                                 */
    float   *within;  /* [points][dim] places in the cell, 0..1, in that order                                            */
    double  *given;   /* [patches][2^dim][dim] scratch                                                                    */
    double  *dense;   /* Cholesky's factor of the coarsest level; NULL where that is only smoothed                        */
    int64_t  dense_rows, bytes;
    peri__mesh_level level[PERI_LEVELS];
};

static void *peri__take_level(peri__multilevel *l, int64_t count, size_t size) {
    l->bytes += count * (int64_t)size;
    return peri__new(&l->memory, count, size);
}

static void peri__give_level(peri__multilevel *l, void *taken, int64_t count, size_t size) {
    if (taken) l->bytes -= count * (int64_t)size;
    peri__delete(&l->memory, taken, count, size);
}

static int peri__take_shares(peri__multilevel *l, peri__shares *s, int64_t rows, int64_t entries) {
    s->rows = rows;
    s->entries = entries;
    s->start = (int64_t *)peri__take_level(l, rows + 1, sizeof *s->start);
    s->node = (int32_t *)peri__take_level(l, entries, sizeof *s->node);
    s->weight = (float *)peri__take_level(l, entries, sizeof *s->weight);
    return s->start && s->node && s->weight;
}

static void peri__give_shares(peri__multilevel *l, peri__shares *s) {
    peri__give_level(l, s->start, s->rows + 1, sizeof *s->start);
    peri__give_level(l, s->node, s->entries, sizeof *s->node);
    peri__give_level(l, s->weight, s->entries, sizeof *s->weight);
    memset(s, 0, sizeof *s);
}

static void peri__free_levels(peri__multilevel *l) {
    if (!l) return;
    const peri__memory memory = l->memory;
    for (int32_t k = 0; k < PERI_LEVELS; ++k) {
        peri__mesh_level *v = &l->level[k];
        int64_t n = v->count * l->dim;
        peri__give_level(l, v->first, v->site_count + 1, sizeof *v->first);
        peri__give_level(l, v->start, v->count + 1, sizeof *v->start);
        peri__give_level(l, v->column, v->entries, sizeof *v->column);
        peri__give_level(l, v->block, v->entries * l->dim * l->dim, sizeof *v->block);
        peri__give_level(l, v->inverse, n * l->dim, sizeof *v->inverse);
        peri__give_level(l, v->x, n, sizeof *v->x);
        peri__give_level(l, v->r, n, sizeof *v->r);
        peri__give_level(l, v->step, n, sizeof *v->step);
        peri__give_level(l, v->product, n, sizeof *v->product);
        peri__give_shares(l, &v->up);
        peri__give_shares(l, &v->down);
    }
    peri__give_level(l, l->start, l->patches + 1, sizeof *l->start);
    peri__give_level(l, l->order, l->points, sizeof *l->order);
    peri__give_level(l, l->node, l->patches << l->dim, sizeof *l->node);
    peri__give_level(l, l->within, l->points * l->dim, sizeof *l->within);
    peri__give_level(l, l->given, l->patches * l->dim << l->dim, sizeof *l->given);
    peri__give_level(l, l->dense, l->dense_rows * l->dense_rows, sizeof *l->dense);
    peri__delete(&memory, l, 1, sizeof *l);
}

/* ---- on one level ------------------------------------------------------------------------------------------------- */

typedef struct peri__level_task {
    const peri__multilevel *l;
    const peri__mesh_level *fine;
    peri__mesh_level *coarse; /* may be NULL                                                                                   */
    const double *in;
    double *out;
} peri__level_task;

/* out = block in, of one node; dim is a constant where this is inlined. */
PERI_INLINE void peri__node_product(const peri__level_task *t, int64_t n, const int dim) {
    const peri__mesh_level *v = t->fine;
    double sum[3] = { 0.0, 0.0, 0.0 };
    for (int64_t e = v->start[n]; e < v->start[n + 1]; ++e) {
        const float *block = &v->block[e * dim * dim];
        const double *in = &t->in[(int64_t)v->column[e] * dim];
        for (int p = 0; p < dim; ++p)
            for (int q = 0; q < dim; ++q) sum[p] += (double)block[p * dim + q] * in[q];
    }
    for (int p = 0; p < dim; ++p) t->out[n * dim + p] = sum[p];
}

static void peri__level_product(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__level_task *t = (const peri__level_task *)context;
    (void)sums;
    for (int64_t n = begin; n < end; ++n) {
        if (t->l->dim == 3) peri__node_product(t, n, 3);
        else peri__node_product(t, n, 2);
    }
}

static void peri__multiply_level(const peri__multilevel *l, const peri_body *b, const peri__mesh_level *v, const double *in, double *out) {
    peri__level_task t;
    memset(&t, 0, sizeof t);
    t.l = l;
    t.fine = v;
    t.in = in;
    t.out = out;
    peri__for_points(b, v->count, l->dim == 3 ? 216 : 72, peri__level_product, &t, NULL);
}

/* out = keep out + gain inverse in, of one level. */
static void peri__level_scale(const peri__multilevel *l, const peri__mesh_level *v, double keep, double gain, const double *in,
                              double *out) {
    const int dim = l->dim;
    for (int64_t n = 0; n < v->count; ++n)
        for (int p = 0; p < dim; ++p) {
            double sum = 0.0;
            for (int q = 0; q < dim; ++q) sum += (double)v->inverse[(n * dim + p) * dim + q] * in[n * dim + q];
            out[n * dim + p] = keep * out[n * dim + p] + gain * sum;
        }
}

/* The entry of a row with this column, which it has. */
static int64_t peri__entry_of(const peri__mesh_level *v, int64_t row, int32_t column) {
    int64_t e = v->start[row];
    while (v->column[e] != column) ++e;
    return e;
}

/* Inverses of the diagonal, and the largest eigenvalue by power iterations from a fixed start. */
static void peri__prepare_level(const peri__multilevel *l, const peri_body *b, peri__mesh_level *v) {
    const int dim = l->dim, packed = PERI_PACKED(dim);
    int64_t n = v->count * dim;
    for (int64_t k = 0; k < v->count; ++k) {
        const float *block = &v->block[peri__entry_of(v, k, (int32_t)k) * dim * dim];
        double diagonal[6] = { 0.0 }, inverse[6];
        for (int p = 0; p < dim; ++p)
            for (int q = p; q < dim; ++q)
                diagonal[peri__packed(dim, p, q)] = 0.5 * ((double)block[p * dim + q] + (double)block[q * dim + p]);
        for (int p = 0; p < packed; ++p) inverse[p] = 0.0;
        if (diagonal[0] > 0.0) (void)peri__invert(dim, diagonal, 1e-5, inverse);
        for (int p = 0; p < dim; ++p)
            for (int q = 0; q < dim; ++q) v->inverse[(k * dim + p) * dim + q] = (float)inverse[peri__packed(dim, p, q)];
    }
    for (int64_t k = 0; k < n; ++k) v->x[k] = (double)(k * 7919 % 1009) / 1009.0 - 0.5;
    v->largest = 1.0;
    for (int power = 0; power < 12; ++power) {
        double norm = 0.0;
        peri__multiply_level(l, b, v, v->x, v->product);
        peri__level_scale(l, v, 0.0, 1.0, v->product, v->x);
        for (int64_t k = 0; k < n; ++k) norm = fabs(v->x[k]) > norm ? fabs(v->x[k]) : norm;
        if (!(norm > 0.0)) break;
        v->largest = norm;
        for (int64_t k = 0; k < n; ++k) v->x[k] /= norm;
    }
    v->largest *= 1.15;
}

/* Improves x towards block x = r by Chebyshev's polynomial; from x = 0 where `fresh`. */
static void peri__smooth(const peri__multilevel *l, const peri_body *b, peri__mesh_level *v, int fresh) {
    const double top = v->largest, bottom = top / PERI_SMOOTHED, middle = 0.5 * (top + bottom), half = 0.5 * (top - bottom);
    const int64_t n = v->count * l->dim;
    double rho = half / middle;
    if (fresh) memset(v->x, 0, (size_t)n * sizeof *v->x);
    for (int k = 0; k < PERI_SMOOTHING; ++k) {
        if (fresh && k == 0) memset(v->product, 0, (size_t)n * sizeof *v->product);
        else peri__multiply_level(l, b, v, v->x, v->product);
        double next = k == 0 ? rho : 1.0 / (2.0 * middle / half - rho), keep = k == 0 ? 0.0 : next * rho;
        double gain = k == 0 ? 1.0 / middle : 2.0 * next / half;
        for (int64_t i = 0; i < n; ++i) v->product[i] = v->r[i] - v->product[i];
        peri__level_scale(l, v, keep, gain, v->product, v->step);
        for (int64_t i = 0; i < n; ++i) v->x[i] += v->step[i];
        rho = next;
    }
}

/* ---- between levels ------------------------------------------------------------------------------------------------ */

/* coarse->r = P^T (fine->r - fine->product) */
static void peri__restrict_level(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__level_task *t = (const peri__level_task *)context;
    const peri__shares *down = &t->fine->down;
    const int dim = t->l->dim;
    (void)sums;
    for (int64_t n = begin; n < end; ++n) {
        double sum[3] = { 0.0, 0.0, 0.0 };
        for (int64_t e = down->start[n]; e < down->start[n + 1]; ++e) {
            const int64_t a = (int64_t)down->node[e] * dim;
            for (int p = 0; p < dim; ++p) sum[p] += (double)down->weight[e] * (t->fine->r[a + p] - t->fine->product[a + p]);
        }
        for (int p = 0; p < dim; ++p) t->coarse->r[n * dim + p] = sum[p];
    }
}

/* fine->x += P coarse->x */
static void peri__prolong_level(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__level_task *t = (const peri__level_task *)context;
    const peri__shares *up = &t->fine->up;
    const int dim = t->l->dim;
    (void)sums;
    for (int64_t n = begin; n < end; ++n)
        for (int64_t e = up->start[n]; e < up->start[n + 1]; ++e) {
            const double *x = &t->coarse->x[(int64_t)up->node[e] * dim];
            for (int p = 0; p < dim; ++p) t->fine->x[n * dim + p] += (double)up->weight[e] * x[p];
        }
}

/* The coarsest level, factored once; one that is too large for that is only smoothed. */
static int peri__factor_coarsest(peri__multilevel *l, const peri_body *b) {
    peri__mesh_level *v = &l->level[l->levels - 1];
    const int dim = l->dim;
    int64_t n = v->count * dim;
    if (n > PERI_DENSE_MOST) {
        peri__prepare_level(l, b, v);
        return 1;
    }
    l->dense_rows = n;
    l->dense = (double *)peri__take_level(l, n * n, sizeof *l->dense);
    if (!l->dense) return 0;
    for (int64_t k = 0; k < v->count; ++k)
        for (int64_t e = v->start[k]; e < v->start[k + 1]; ++e)
            for (int p = 0; p < dim; ++p)
                for (int q = 0; q < dim; ++q)
                    l->dense[(k * dim + p) * n + (int64_t)v->column[e] * dim + q] = (double)v->block[(e * dim + p) * dim + q];
    for (int64_t k = 0; k < n; ++k) { /* rows of the lower triangle; a pivot lost to rounding is left out */
        double floor_ = 1e-6 * l->dense[k * n + k];
        for (int64_t j = 0; j <= k; ++j) {
            double sum = l->dense[k * n + j];
            for (int64_t q = 0; q < j; ++q) sum -= l->dense[k * n + q] * l->dense[j * n + q];
            if (j < k) l->dense[k * n + j] = l->dense[j * n + j] > 0.0 ? sum / l->dense[j * n + j] : 0.0;
            else l->dense[k * n + k] = sum > floor_ && sum > 0.0 ? sqrt(sum) : 0.0;
        }
    }
    return 1;
}

static void peri__solve_coarsest(const peri__multilevel *l, const peri_body *b) {
    peri__mesh_level *v = (peri__mesh_level *)&l->level[l->levels - 1];
    const int64_t n = l->dense_rows;
    const double *factor = l->dense;
    if (!factor) {
        peri__smooth(l, b, v, 1);
        return;
    }
    for (int64_t k = 0; k < n; ++k) {
        double sum = v->r[k];
        for (int64_t j = 0; j < k; ++j) sum -= factor[k * n + j] * v->x[j];
        v->x[k] = factor[k * n + k] > 0.0 ? sum / factor[k * n + k] : 0.0;
    }
    for (int64_t k = n - 1; k >= 0; --k) {
        v->x[k] = factor[k * n + k] > 0.0 ? v->x[k] / factor[k * n + k] : 0.0;
        for (int64_t j = 0; j < k; ++j) v->x[j] -= factor[k * n + j] * v->x[k];
    }
}

static void peri__cycle(peri__multilevel *l, const peri_body *b, int32_t k) {
    peri__mesh_level *v = &l->level[k];
    peri__level_task t;
    if (k == l->levels - 1) {
        peri__solve_coarsest(l, b);
        return;
    }
    memset(&t, 0, sizeof t);
    t.l = l;
    t.fine = v;
    t.coarse = v + 1;
    peri__smooth(l, b, v, 1);
    peri__multiply_level(l, b, v, v->x, v->product);
    peri__for_points(b, t.coarse->count, 8 << l->dim, peri__restrict_level, &t, NULL);
    peri__cycle(l, b, k + 1);
    peri__for_points(b, v->count, 8, peri__prolong_level, &t, NULL);
    peri__smooth(l, b, v, 0);
}
