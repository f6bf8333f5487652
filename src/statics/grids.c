/* SPDX-License-Identifier: MIT */
/* grids.c - regular grids with stencils of blocks, each of twice the spacing of the one before: products, smoothing, a V-cycle. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_GRIDS     24
#define PERI_DENSE     200  /* most unknowns of the coarsest grid                                                         */
#define PERI_SMOOTHING 3    /* degree of the polynomials                                                                  */
#define PERI_SMOOTHED  10.0 /* they cover the eigenvalues above the largest over this                                     */

typedef struct peri__grid {
    int64_t nodes[3], count;
    float  *node_blocks; /* [count][3^dim][dim][dim]: node with each node around it, x fastest                           */
    float  *inverse; /* [count][dim][dim] of the diagonal                                                                 */
    double *x, *r, *step, *product; /* [count*dim]                                                                        */
    double  largest; /* eigenvalue of inverse*node_blocks                                                                */
} peri__grid;

struct peri__multilevel {
    peri__memory memory;
    int32_t  dim, around, grids; /* around: 3^dim                                                                         */
    double   origin[3], spacing;
    int64_t  cells[3], cell_count, points;
    int32_t *start;  /* [cell_count+1] first place in order                                                               */
    int32_t *order;  /* [points] by cells                                                                                 */
    float   *within; /* [points][dim] places in the cell, 0..1, in that order                                            */
    double  *given;  /* [cell_count][2^dim][dim] scratch                                                                 */
    double  *dense;  /* Cholesky's factor of the coarsest grid                                                            */
    int64_t  dense_rows, bytes;
    peri__grid grid[PERI_GRIDS];
};

static void *peri__take_level(peri__multilevel *l, int64_t count, size_t size) {
    l->bytes += count * (int64_t)size;
    return peri__new(&l->memory, count, size);
}

static void peri__free_levels(peri__multilevel *l) {
    if (!l) return;
    const peri__memory memory = l->memory;
    for (int32_t g = 0; g < PERI_GRIDS; ++g) {
        peri__grid *grid = &l->grid[g];
        int64_t n = grid->count * l->dim;
        peri__delete(&memory, grid->node_blocks, n * l->dim * l->around, sizeof(float));
        peri__delete(&memory, grid->inverse, n * l->dim, sizeof(float));
        peri__delete(&memory, grid->x, n, sizeof(double));
        peri__delete(&memory, grid->r, n, sizeof(double));
        peri__delete(&memory, grid->step, n, sizeof(double));
        peri__delete(&memory, grid->product, n, sizeof(double));
    }
    peri__delete(&memory, l->start, l->cell_count + 1, sizeof *l->start);
    peri__delete(&memory, l->order, l->points, sizeof *l->order);
    peri__delete(&memory, l->within, l->points * l->dim, sizeof *l->within);
    peri__delete(&memory, l->given, l->cell_count * l->dim << l->dim, sizeof *l->given);
    peri__delete(&memory, l->dense, l->dense_rows * l->dense_rows, sizeof(double));
    peri__delete(&memory, l, 1, sizeof *l);
}

static int peri__take_grid(peri__multilevel *l, peri__grid *g) {
    int64_t n = g->count * l->dim;
    g->node_blocks = (float *)peri__take_level(l, n * l->dim * l->around, sizeof(float));
    g->inverse = (float *)peri__take_level(l, n * l->dim, sizeof(float));
    g->x = (double *)peri__take_level(l, n, sizeof(double));
    g->r = (double *)peri__take_level(l, n, sizeof(double));
    g->step = (double *)peri__take_level(l, n, sizeof(double));
    g->product = (double *)peri__take_level(l, n, sizeof(double));
    return g->node_blocks && g->inverse && g->x && g->r && g->step && g->product;
}

/* ---- on one grid -------------------------------------------------------------------------------------------------- */

typedef struct peri__grid_task {
    const peri__multilevel *l;
    peri__grid *fine, *coarse; /* coarse may be NULL                                                                     */
    const double *in;
    double *out;
} peri__grid_task;

/* Node numbers to places and back. */
static void peri__node_place(const peri__grid *g, int32_t dim, int64_t node, int64_t *at) {
    at[2] = 0;
    for (int32_t d = 0; d < dim; ++d) {
        at[d] = node % g->nodes[d];
        node /= g->nodes[d];
    }
}

/* The node `offset` (of 3^dim) beside the one at a place; -1 outside. */
static int64_t peri__beside(const peri__grid *g, int32_t dim, const int64_t *at, int offset) {
    int64_t node = 0, step = 1;
    for (int32_t d = 0; d < dim; ++d) {
        int64_t k = at[d] + offset % 3 - 1;
        if (k < 0 || k >= g->nodes[d]) return -1;
        node += k * step;
        step *= g->nodes[d];
        offset /= 3;
    }
    return node;
}

/* out = node_blocks in, of one node; dim is a constant where this is inlined. */
PERI_INLINE void peri__node_product(const peri__grid_task *t, int64_t n, const int dim) {
    const peri__grid *g = t->fine;
    const int around = dim == 3 ? 27 : 9;
    const float *block = &g->node_blocks[n * around * dim * dim];
    double sum[3] = { 0.0, 0.0, 0.0 };
    int64_t at[3] = { 0, 0, 0 };
    int inside = 1;
    peri__node_place(g, dim, n, at);
    for (int d = 0; d < dim; ++d) inside &= at[d] > 0 && at[d] < g->nodes[d] - 1;
    for (int o = 0; o < around; ++o, block += dim * dim) {
        int64_t other = inside ? n + (o % 3 - 1) + (o / 3 % 3 - 1) * g->nodes[0] : peri__beside(g, dim, at, o);
        if (inside && dim == 3) other += (o / 9 - 1) * g->nodes[0] * g->nodes[1];
        if (other < 0) continue;
        for (int p = 0; p < dim; ++p)
            for (int q = 0; q < dim; ++q) sum[p] += (double)block[p * dim + q] * t->in[other * dim + q];
    }
    for (int p = 0; p < dim; ++p) t->out[n * dim + p] = sum[p];
}

static void peri__grid_product(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__grid_task *t = (const peri__grid_task *)context;
    (void)sums;
    for (int64_t n = begin; n < end; ++n) {
        if (t->l->dim == 3) peri__node_product(t, n, 3);
        else peri__node_product(t, n, 2);
    }
}

static void peri__multiply_grid(const peri__multilevel *l, const peri_body *b, peri__grid *g, const double *in, double *out) {
    peri__grid_task t;
    memset(&t, 0, sizeof t);
    t.l = l;
    t.fine = g;
    t.in = in;
    t.out = out;
    peri__for_points(b, g->count, 8 * l->around, peri__grid_product, &t, NULL);
}

/* out = keep out + gain inverse in, of one grid. */
static void peri__grid_scale(const peri__multilevel *l, const peri__grid *g, double keep, double gain, const double *in, double *out) {
    const int dim = l->dim;
    for (int64_t n = 0; n < g->count; ++n)
        for (int p = 0; p < dim; ++p) {
            double sum = 0.0;
            for (int q = 0; q < dim; ++q) sum += (double)g->inverse[(n * dim + p) * dim + q] * in[n * dim + q];
            out[n * dim + p] = keep * out[n * dim + p] + gain * sum;
        }
}

/* Inverses of the diagonal, and the largest eigenvalue by power iterations from a fixed start. */
static void peri__prepare_grid(const peri__multilevel *l, const peri_body *b, peri__grid *g) {
    const int dim = l->dim, packed = PERI_PACKED(dim);
    int64_t n = g->count * dim;
    for (int64_t k = 0; k < g->count; ++k) {
        const float *block = &g->node_blocks[(k * l->around + l->around / 2) * dim * dim];
        double diagonal[6] = { 0.0 }, inverse[6];
        for (int p = 0; p < dim; ++p)
            for (int q = p; q < dim; ++q)
                diagonal[peri__packed(dim, p, q)] = 0.5 * ((double)block[p * dim + q] + (double)block[q * dim + p]);
        for (int p = 0; p < packed; ++p) inverse[p] = 0.0;
        if (diagonal[0] > 0.0) (void)peri__invert(dim, diagonal, 1e-5, inverse);
        for (int p = 0; p < dim; ++p)
            for (int q = 0; q < dim; ++q) g->inverse[(k * dim + p) * dim + q] = (float)inverse[peri__packed(dim, p, q)];
    }
    for (int64_t k = 0; k < n; ++k) g->x[k] = (double)(k * 7919 % 1009) / 1009.0 - 0.5;
    g->largest = 1.0;
    for (int power = 0; power < 12; ++power) {
        double norm = 0.0;
        peri__multiply_grid(l, b, g, g->x, g->product);
        peri__grid_scale(l, g, 0.0, 1.0, g->product, g->x);
        for (int64_t k = 0; k < n; ++k) norm = fabs(g->x[k]) > norm ? fabs(g->x[k]) : norm;
        if (!(norm > 0.0)) break;
        g->largest = norm;
        for (int64_t k = 0; k < n; ++k) g->x[k] /= norm;
    }
    g->largest *= 1.15;
}

/* Improves x towards node_blocks x = r by Chebyshev's polynomial; from x = 0 where `fresh`. */
static void peri__smooth(const peri__multilevel *l, const peri_body *b, peri__grid *g, int fresh) {
    const double top = g->largest, bottom = top / PERI_SMOOTHED, middle = 0.5 * (top + bottom), half = 0.5 * (top - bottom);
    const int64_t n = g->count * l->dim;
    double rho = half / middle;
    if (fresh) memset(g->x, 0, (size_t)n * sizeof *g->x);
    for (int k = 0; k < PERI_SMOOTHING; ++k) {
        if (fresh && k == 0) memset(g->product, 0, (size_t)n * sizeof *g->product);
        else peri__multiply_grid(l, b, g, g->x, g->product);
        double next = k == 0 ? rho : 1.0 / (2.0 * middle / half - rho), keep = k == 0 ? 0.0 : next * rho;
        double gain = k == 0 ? 1.0 / middle : 2.0 * next / half;
        for (int64_t i = 0; i < n; ++i) g->product[i] = g->r[i] - g->product[i];
        peri__grid_scale(l, g, keep, gain, g->product, g->step);
        for (int64_t i = 0; i < n; ++i) g->x[i] += g->step[i];
        rho = next;
    }
}

/* ---- between grids ------------------------------------------------------------------------------------------------ */

/* The coarse nodes whose shape function reaches fine place k of an axis: one or two, each of `weight`. */
static int peri__parents(int64_t k, int64_t *parent, double *weight) {
    parent[0] = k / 2;
    parent[1] = k / 2 + 1;
    *weight = k % 2 ? 0.5 : 1.0;
    return k % 2 ? 2 : 1;
}

/* coarse node_blocks = P^T node_blocks P */
static void peri__galerkin(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__grid_task *t = (const peri__grid_task *)context;
    const peri__grid *f = t->fine, *c = t->coarse;
    const int dim = t->l->dim, around = t->l->around, size = dim * dim;
    (void)sums;
    for (int64_t n = begin; n < end; ++n) {
        double sum[27 * 9] = { 0.0 };
        int64_t at[3] = { 0, 0, 0 }, fine[3];
        peri__node_place(c, dim, n, at);
        for (int d = 0; d < 3; ++d) fine[d] = 2 * at[d];
        for (int o = 0; o < around; ++o) { /* fine nodes a under the shape function of n */
            int64_t a = peri__beside(f, dim, fine, o), place[3] = { 0, 0, 0 };
            double own = 1.0;
            if (a < 0) continue;
            for (int d = 0, rest = o; d < dim; ++d, rest /= 3) {
                place[d] = fine[d] + rest % 3 - 1;
                if (rest % 3 != 1) own *= 0.5;
            }
            for (int e = 0; e < around; ++e) { /* beside them b, and its parents */
                int64_t b = peri__beside(f, dim, place, e), parent[3][2];
                double weight[3], share = own;
                int parents[3] = { 1, 1, 1 };
                if (b < 0) continue;
                for (int d = 0, rest = e; d < dim; ++d, rest /= 3) {
                    parents[d] = peri__parents(place[d] + rest % 3 - 1, parent[d], &weight[d]);
                    share *= weight[d];
                }
                const float *block = &f->node_blocks[(a * around + e) * size];
                for (int k = 0; k < parents[0] * parents[1] * (dim == 3 ? parents[2] : 1); ++k) {
                    int pick = k, offset = 0, step = 1;
                    for (int d = 0; d < dim; ++d, step *= 3) {
                        offset += (int)(parent[d][pick % parents[d]] - at[d] + 1) * step;
                        pick /= parents[d];
                    }
                    for (int p = 0; p < size; ++p) sum[offset * size + p] += share * (double)block[p];
                }
            }
        }
        for (int k = 0; k < around * size; ++k) c->node_blocks[n * around * size + k] = (float)sum[k];
    }
}

/* coarse->r = P^T (fine->r - fine->product) */
static void peri__restrict_grid(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__grid_task *t = (const peri__grid_task *)context;
    const int dim = t->l->dim;
    (void)sums;
    for (int64_t n = begin; n < end; ++n) {
        int64_t at[3] = { 0, 0, 0 };
        double sum[3] = { 0.0, 0.0, 0.0 };
        peri__node_place(t->coarse, dim, n, at);
        for (int d = 0; d < 3; ++d) at[d] *= 2;
        for (int o = 0; o < t->l->around; ++o) {
            int64_t a = peri__beside(t->fine, dim, at, o);
            double weight = 1.0;
            if (a < 0) continue;
            for (int d = 0, rest = o; d < dim; ++d, rest /= 3) weight *= rest % 3 == 1 ? 1.0 : 0.5;
            for (int p = 0; p < dim; ++p) sum[p] += weight * (t->fine->r[a * dim + p] - t->fine->product[a * dim + p]);
        }
        for (int p = 0; p < dim; ++p) t->coarse->r[n * dim + p] = sum[p];
    }
}

/* fine->x += P coarse->x */
static void peri__prolong_grid(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__grid_task *t = (const peri__grid_task *)context;
    const int dim = t->l->dim;
    (void)sums;
    for (int64_t n = begin; n < end; ++n) {
        int64_t at[3] = { 0, 0, 0 }, parent[3][2];
        double weight = 1.0, one;
        int parents[3] = { 1, 1, 1 };
        peri__node_place(t->fine, dim, n, at);
        for (int d = 0; d < dim; ++d) {
            parents[d] = peri__parents(at[d], parent[d], &one);
            weight *= one;
        }
        for (int k = 0; k < parents[0] * parents[1] * parents[2]; ++k) {
            int pick = k;
            int64_t node = 0, step = 1;
            for (int d = 0; d < dim; ++d) {
                node += parent[d][pick % parents[d]] * step;
                step *= t->coarse->nodes[d];
                pick /= parents[d];
            }
            for (int p = 0; p < dim; ++p) t->fine->x[n * dim + p] += weight * t->coarse->x[node * dim + p];
        }
    }
}

/* The coarsest grid, factored once. */
static int peri__factor_coarsest(peri__multilevel *l) {
    const peri__grid *g = &l->grid[l->grids - 1];
    const int dim = l->dim;
    int64_t n = g->count * dim;
    l->dense_rows = n;
    l->dense = (double *)peri__take_level(l, n * n, sizeof *l->dense);
    if (!l->dense) return 0;
    for (int64_t k = 0; k < g->count; ++k) {
        int64_t at[3] = { 0, 0, 0 };
        peri__node_place(g, dim, k, at);
        for (int o = 0; o < l->around; ++o) {
            int64_t other = peri__beside(g, dim, at, o);
            for (int p = 0; other >= 0 && p < dim; ++p)
                for (int q = 0; q < dim; ++q)
                    l->dense[(k * dim + p) * n + other * dim + q] = (double)g->node_blocks[((k * l->around + o) * dim + p) * dim + q];
        }
    }
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

static void peri__solve_coarsest(const peri__multilevel *l) {
    const peri__grid *g = &l->grid[l->grids - 1];
    const int64_t n = l->dense_rows;
    const double *factor = l->dense;
    for (int64_t k = 0; k < n; ++k) {
        double sum = g->r[k];
        for (int64_t j = 0; j < k; ++j) sum -= factor[k * n + j] * g->x[j];
        g->x[k] = factor[k * n + k] > 0.0 ? sum / factor[k * n + k] : 0.0;
    }
    for (int64_t k = n - 1; k >= 0; --k) {
        g->x[k] = factor[k * n + k] > 0.0 ? g->x[k] / factor[k * n + k] : 0.0;
        for (int64_t j = 0; j < k; ++j) g->x[j] -= factor[k * n + j] * g->x[k];
    }
}

static void peri__cycle(peri__multilevel *l, const peri_body *b, int32_t level) {
    peri__grid *g = &l->grid[level];
    peri__grid_task t;
    if (level == l->grids - 1) {
        peri__solve_coarsest(l);
        return;
    }
    memset(&t, 0, sizeof t);
    t.l = l;
    t.fine = g;
    t.coarse = g + 1;
    peri__smooth(l, b, g, 1);
    peri__multiply_grid(l, b, g, g->x, g->product);
    peri__for_points(b, t.coarse->count, l->around, peri__restrict_grid, &t, NULL);
    peri__cycle(l, b, level + 1);
    peri__for_points(b, g->count, 8, peri__prolong_grid, &t, NULL);
    peri__smooth(l, b, g, 0);
}
