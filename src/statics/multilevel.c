/* SPDX-License-Identifier: MIT */
/* multilevel.c - linear elasticity on coarse background grids, as a preconditioner.

   The diagonal blocks alone deal with all motions that vary within a horizon: for them the bonds of a point act like a spring to a still
   neighbourhood. What is left is smooth, and to smooth motions a peridynamic solid is an elastic one. So the preconditioner adds
       z = D^-1 r  +  P B P^T r,
   P the (bi-, tri-) linear interpolation from the nodes of a regular grid of about a horizon to the points, of a lattice or a cloud, and
   B a V-cycle for the stiffness of linear elasticity in those shape functions, integrated over the points: V_i grad N:C_i:grad N, C_i of
   the point's law, scaled by the stiffness of its actual bonds. Points that are constrained add D_ii N N, the resistance of their bonds.
   Coarser grids have twice the spacing, and stiffness by Galerkin's product; there Chebyshev's polynomials smooth, and the coarsest is
   solved directly. Everything is symmetric and the order of sums fixed. Nodes without points have a zero diagonal and stay 0. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* ---- the finest grid ---------------------------------------------------------------------------------------------- */

/* The cell of a point, and where in it (0..1 per axis). */
static int64_t peri__grid_cell(const peri__multilevel *l, const peri_body *b, int64_t i, double *within) {
    int64_t cell = 0;
    for (int32_t d = l->dim - 1; d >= 0; --d) {
        double at = (peri__get_real(b->model->x, b->f32, d * b->model->stride + i) - l->origin[d]) / l->spacing;
        int64_t k = at > 0.0 ? (int64_t)at : 0;
        if (k >= l->cells[d]) k = l->cells[d] - 1;
        within[d] = at - (double)k;
        cell = cell * l->cells[d] + k;
    }
    return cell;
}

/* Node of corner c (bit d: the upper one of axis d) of a cell. */
static int64_t peri__corner(const peri__multilevel *l, int64_t cell, int c) {
    const peri__grid *g = &l->grid[0];
    int64_t node = 0, step = 1;
    for (int32_t d = 0; d < l->dim; ++d) {
        node += (cell % l->cells[d] + (c >> d & 1)) * step;
        cell /= l->cells[d];
        step *= g->nodes[d];
    }
    return node;
}

/* Lays the finest grid over the body and sorts the points by its cells. */
static int peri__lay_grid(peri__multilevel *l, const peri_body *b) {
    const peri__model *m = b->model;
    double lo[3] = { 0.0 }, hi[3] = { 0.0 };
    for (int32_t d = 0; d < l->dim; ++d) {
        lo[d] = hi[d] = peri__get_real(m->x, b->f32, d * m->stride);
        for (int64_t i = 1; i < m->points; ++i) {
            double x = peri__get_real(m->x, b->f32, d * m->stride + i);
            lo[d] = x < lo[d] ? x : lo[d];
            hi[d] = x > hi[d] ? x : hi[d];
        }
    }
    l->spacing = m->horizon > 2.0 * m->spacing ? m->horizon : 2.0 * m->spacing;
    for (;;) { /* sparse clouds in large boxes get a coarser grid: not more cells than points */
        double cells = 1.0;
        for (int32_t d = 0; d < l->dim; ++d) cells *= (hi[d] - lo[d]) / l->spacing + 1.0;
        if (cells <= (double)m->points + 8.0) break;
        l->spacing *= 1.25;
    }
    l->cell_count = 1;
    peri__grid *g = &l->grid[0];
    g->count = 1;
    for (int32_t d = 0; d < l->dim; ++d) {
        l->cells[d] = (int64_t)ceil((hi[d] - lo[d]) / l->spacing * (1.0 - 1e-9));
        if (l->cells[d] < 1) l->cells[d] = 1;
        l->origin[d] = 0.5 * (lo[d] + hi[d] - (double)l->cells[d] * l->spacing);
        l->cell_count *= l->cells[d];
        g->nodes[d] = l->cells[d] + 1;
        g->count *= g->nodes[d];
    }
    l->start = (int32_t *)peri__take_level(l, l->cell_count + 1, sizeof *l->start);
    l->order = (int32_t *)peri__take_level(l, m->points, sizeof *l->order);
    l->within = (float *)peri__take_level(l, m->points * l->dim, sizeof *l->within);
    l->given = (double *)peri__take_level(l, l->cell_count * l->dim << l->dim, sizeof *l->given);
    l->points = m->points;
    if (!l->start || !l->order || !l->within || !l->given) return 0;
    double within[3] = { 0.0 };
    for (int64_t i = 0; i < m->points; ++i) l->start[peri__grid_cell(l, b, i, within) + 1]++;
    for (int64_t c = 0; c < l->cell_count; ++c) l->start[c + 1] += l->start[c];
    for (int64_t i = m->points - 1; i >= 0; --i) { /* fills each cell from its end; starts shift down and are put back */
        int64_t c = peri__grid_cell(l, b, i, within);
        l->order[--l->start[c + 1]] = (int32_t)i;
        for (int32_t d = 0; d < l->dim; ++d) l->within[l->start[c + 1] * l->dim + d] = (float)within[d];
    }
    for (int64_t c = 0; c < l->cell_count; ++c) l->start[c] = l->start[c + 1];
    l->start[l->cell_count] = (int32_t)m->points;
    return 1;
}

/* How stiff the bonds of point i are, over those of its material alone, whole: softer where bonds of springs are broken (state-based laws
   are calibrated on what is left), stiffer beside a stiffer material, whose half of the bonds reaches here. */
static double peri__relative_stiffness(const peri_body *b, int64_t i) {
    const peri__model *m = b->model;
    const int32_t own = m->material[i], springs = m->laws[own].pairwise;
    double all = 0.0, live = 0.0;
    peri__row row;
    if (m->materials == 1 && !(springs && b->alive)) return 1.0;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        const int32_t other = m->material[row.ids[k]], alive = peri__is_alive(b, i, k);
        double share = fabs(peri__get_real(row.weight, b->b32, k)) * peri__get_real(row.bond, b->b32, k), ratio;
        if (springs && m->laws[other].pairwise)
            ratio = m->pairs[own * m->materials + other].c / m->pairs[own * m->materials + own].c;
        else
            ratio = 0.5 + 0.5 * m->laws[other].mu / m->laws[own].mu;
        if (springs || alive) all += share;
        if (alive) live += share * ratio;
    }
    return all > 0.0 ? live / all + 1e-3 : 1e-3;
}

/* Adds point i to the stiffness of the corners of its cell. */
static void peri__add_point(const peri__solver *s, peri__multilevel *l, int64_t i) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    const peri__law *law = &m->laws[m->material[i]];
    const int dim = l->dim, corners = 1 << dim;
    double within[3] = { 0.0 }, shape[8], gradient[8][3], volume = m->volume[i] * peri__relative_stiffness(b, i);
    double lambda = law->lambda, mu = law->mu;
    int64_t cell = peri__grid_cell(l, b, i, within), node[8];
    float *node_blocks = l->grid[0].node_blocks;
    for (int c = 0; c < corners; ++c) {
        node[c] = peri__corner(l, cell, c);
        shape[c] = 1.0;
        for (int d = 0; d < dim; ++d) shape[c] *= c >> d & 1 ? within[d] : 1.0 - within[d];
        for (int d = 0; d < dim; ++d) {
            gradient[c][d] = (c >> d & 1 ? 1.0 : -1.0) / l->spacing;
            for (int e = 0; e < dim; ++e)
                if (e != d) gradient[c][d] *= c >> e & 1 ? within[e] : 1.0 - within[e];
        }
    }
    for (int a = 0; a < corners; ++a)
        for (int c = 0; c < corners; ++c) {
            int offset = 0, step = 1;
            for (int d = 0; d < dim; ++d, step *= 3) offset += ((c >> d & 1) - (a >> d & 1) + 1) * step;
            float *block = node_blocks + (node[a] * l->around + offset) * dim * dim;
            double dot = volume * mu * peri__dot(gradient[a], gradient[c], dim);
            for (int p = 0; p < dim; ++p)
                for (int q = 0; q < dim; ++q) {
                    double sum = volume * (lambda * gradient[a][p] * gradient[c][q] + mu * gradient[a][q] * gradient[c][p]);
                    if (p == q) sum += dot;
                    if (p == q && (s->constrained[i] >> p & 1))
                        sum += shape[a] * shape[c] * peri__get_real(s->blocks, b->f32, p * m->stride + i);
                    block[p * dim + q] += (float)sum;
                }
        }
}

/* ---- between the points and the finest grid ------------------------------------------------------------------------ */

typedef struct peri__transfer {
    const peri__solver *solver;
    peri__multilevel   *levels;
} peri__transfer;

/* Shape functions of the corners of a cell at place o of the order. */
PERI_INLINE void peri__shapes(const peri__multilevel *l, int64_t o, const int dim, double *shape) {
    const float *within = &l->within[o * dim];
    shape[0] = 1.0;
    for (int d = 0; d < dim; ++d)
        for (int c = 0; c < 1 << d; ++c) {
            shape[c | 1 << d] = shape[c] * (double)within[d];
            shape[c] *= 1.0 - (double)within[d];
        }
}

/* r of the nodes = P^T r of the points, the constrained ones left out: first what each cell gives to its corners, then the sum of cells. */
static void peri__restrict_cells(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__transfer *t = (const peri__transfer *)context;
    const peri__multilevel *l = t->levels;
    const peri_body *b = t->solver->body;
    const int dim = l->dim, corners = 1 << dim;
    (void)sums;
    for (int64_t cell = begin; cell < end; ++cell) {
        double sum[24] = { 0.0 }, shape[8];
        for (int64_t o = l->start[cell]; o < l->start[cell + 1]; ++o) {
            const int64_t i = l->order[o];
            peri__shapes(l, o, dim, shape);
            for (int d = 0; d < dim; ++d) {
                if (t->solver->constrained[i] >> d & 1) continue;
                double r = peri__get_real(t->solver->k.r, b->f32, d * b->model->stride + i);
                for (int c = 0; c < corners; ++c) sum[c * dim + d] += shape[c] * r;
            }
        }
        memcpy(&l->given[cell * corners * dim], sum, (size_t)(corners * dim) * sizeof *sum);
    }
}

static void peri__gather_cells(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__transfer *t = (const peri__transfer *)context;
    const peri__multilevel *l = t->levels;
    const peri__grid *g = &l->grid[0];
    const int dim = l->dim, corners = 1 << dim;
    (void)sums;
    for (int64_t n = begin; n < end; ++n) {
        int64_t at[3] = { 0, 0, 0 };
        double sum[3] = { 0.0, 0.0, 0.0 };
        peri__node_place(g, dim, n, at);
        for (int c = 0; c < corners; ++c) { /* the cells of which the node is corner c */
            int64_t cell = 0;
            int outside = 0;
            for (int d = dim - 1; d >= 0; --d) {
                int64_t k = at[d] - (c >> d & 1);
                outside |= k < 0 || k >= l->cells[d];
                cell = cell * l->cells[d] + k;
            }
            for (int d = 0; !outside && d < dim; ++d) sum[d] += l->given[(cell * corners + c) * dim + d];
        }
        for (int d = 0; d < dim; ++d) g->r[n * dim + d] = sum[d];
    }
}

/* z of the points of cells += P x of the nodes, but for what is constrained. */
static void peri__prolong_cells(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__transfer *t = (const peri__transfer *)context;
    const peri__multilevel *l = t->levels;
    const peri_body *b = t->solver->body;
    const int dim = l->dim, corners = 1 << dim;
    void *z = t->solver->k.z;
    (void)sums;
    for (int64_t cell = begin; cell < end; ++cell) {
        double x[24], shape[8];
        for (int c = 0; c < corners; ++c) memcpy(&x[c * dim], &l->grid[0].x[peri__corner(l, cell, c) * dim], (size_t)dim * sizeof *x);
        for (int64_t o = l->start[cell]; o < l->start[cell + 1]; ++o) {
            const int64_t i = l->order[o];
            peri__shapes(l, o, dim, shape);
            for (int d = 0; d < dim; ++d) {
                const int64_t at = d * b->model->stride + i;
                double sum = 0.0;
                if (t->solver->constrained[i] >> d & 1) continue;
                for (int c = 0; c < corners; ++c) sum += shape[c] * x[c * dim + d];
                peri__put_real(z, b->f32, at, peri__get_real(z, b->f32, at) + sum);
            }
        }
    }
}

/* Builds the grids for the body as it is; s->blocks are the diagonal blocks, not yet inverted. NULL where memory is short. */
static peri__multilevel *peri__build_levels(const peri__solver *s) {
    const peri_body *b = s->body;
    peri__multilevel *l = (peri__multilevel *)peri__new(&b->scratch, 1, sizeof *l);
    if (!l) return NULL;
    l->memory = b->scratch;
    l->dim = b->dim;
    l->around = b->dim == 3 ? 27 : 9;
    l->bytes = (int64_t)sizeof *l;
    int ok = peri__lay_grid(l, b) && peri__take_grid(l, &l->grid[0]);
    for (int64_t k = 0; ok && k < l->points; ++k) peri__add_point(s, l, l->order[k]);
    l->grids = 1;
    while (ok && l->grids < PERI_GRIDS && l->grid[l->grids - 1].count * l->dim > PERI_DENSE) {
        peri__grid *fine = &l->grid[l->grids - 1], *coarse = &l->grid[l->grids];
        peri__grid_task task;
        coarse->count = 1;
        for (int32_t d = 0; d < l->dim; ++d) {
            coarse->nodes[d] = fine->nodes[d] / 2 + 1;
            coarse->count *= coarse->nodes[d];
        }
        ok = peri__take_grid(l, coarse);
        if (!ok) break;
        l->grids++;
        memset(&task, 0, sizeof task);
        task.l = l;
        task.fine = fine;
        task.coarse = coarse;
        peri__for_points(b, coarse->count, l->around * l->around * 10, peri__galerkin, &task, NULL);
        peri__prepare_grid(l, b, fine);
    }
    if (ok && peri__factor_coarsest(l)) return l;
    peri__free_levels(l);
    return NULL;
}

/* z += P B P^T r */
static void peri__correct_coarsely(const peri__solver *s) {
    peri__transfer t;
    t.solver = s;
    t.levels = s->levels;
    peri__for_points(s->body, t.levels->cell_count, 100, peri__restrict_cells, &t, NULL);
    peri__for_points(s->body, t.levels->grid[0].count, 10, peri__gather_cells, &t, NULL);
    peri__cycle(t.levels, s->body, 0);
    peri__for_points(s->body, t.levels->cell_count, 100, peri__prolong_cells, &t, NULL);
}
