/* SPDX-License-Identifier: MIT */
/* multilevel.c - linear elasticity on coarse background grids, as a preconditioner.

   The diagonal blocks alone deal with all motions that vary within a horizon: for them the bonds of a point act like a spring to a still
   neighbourhood. What is left is smooth but across cracks, and to smooth motions a peridynamic solid is an elastic one. So the
   preconditioner adds
       z = D^-1 r  +  P B P^T r,
   P the (bi-, tri-) linear interpolation from the nodes of a regular grid of about a horizon to the points, of a lattice or a cloud, and
   B a V-cycle for the stiffness of linear elasticity in those shape functions, integrated over the points: V_i grad N:C_i:grad N, C_i of
   the point's law, scaled by the stiffness of its actual bonds. Points that are constrained add D_ii N N, the resistance of their bonds.
   A patch is the connected points of a cell of the grid; the nodes at the corners of its cell are its own where no live bonds lead round
   to the other patches: levels.c. Coarser levels have twice the spacing, and stiffness by Galerkin's product; there Chebyshev's polynomials
   smooth, and the coarsest is solved directly. Everything is symmetric and the order of sums fixed. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

/* ---- the cells and their patches ------------------------------------------------------------------------------------ */

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

/* Lays the cells over the body. */
static void peri__lay_grid(peri__multilevel *l, const peri_body *b) {
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
    for (int32_t d = 0; d < l->dim; ++d) {
        l->cells[d] = (int64_t)ceil((hi[d] - lo[d]) / l->spacing * (1.0 - 1e-9));
        if (l->cells[d] < 1) l->cells[d] = 1;
        l->origin[d] = 0.5 * (lo[d] + hi[d] - (double)l->cells[d] * l->spacing);
        l->cell_count *= l->cells[d];
    }
    l->points = m->points;
}

/* Numbers the patches, cell by cell and by their first points: patch[i] becomes the least point of that of i; cell[i] is where i is.
   `patches`, which the finest level is made of, gets first and count. left[cells] is scratch: what is still to be joined, plus 1. */
static void peri__number_patches(peri__multilevel *l, const peri_body *b, const int32_t *cell, int32_t *patch, int64_t *left,
                                 peri__mesh_level *patches) {
    const int64_t points = b->model->points;
    peri__row row;
    for (int64_t i = 0; i < points; ++i) {
        patch[i] = (int32_t)i;
        left[cell[i]]++;
    }
    for (int64_t i = 0; i < points; ++i) {
        if (left[cell[i]] == 1) continue;
        peri__read_row(b, i, &row);
        for (int64_t k = 0; k < row.count; ++k)
            if (cell[row.ids[k]] == cell[i] && peri__is_alive(b, i, k)) left[cell[i]] -= peri__join_roots(patch, (int32_t)i, row.ids[k]);
    }
    for (int64_t i = 0; i < points; ++i)
        if ((patch[i] = peri__root_among(patch, (int32_t)i)) == i) patches->first[cell[i] + 1]++;
    for (int64_t c = 0; c < l->cell_count; ++c) patches->first[c + 1] += patches->first[c];
    patches->count = l->patches = patches->first[l->cell_count];
}

static int peri__take_patches(peri__multilevel *l, const peri_body *b, const int32_t *cell, int32_t *patch, peri__mesh_level *patches) {
    const peri__model *m = b->model;
    patches->site_count = l->cell_count;
    for (int32_t d = 0; d < l->dim; ++d) patches->sites[d] = l->cells[d];
    patches->first = (int64_t *)peri__take_level(l, l->cell_count + 1, sizeof *patches->first);
    int64_t *next = (int64_t *)peri__take_level(l, l->cell_count, sizeof *next);
    int ok = patches->first && next;
    if (ok) {
        peri__number_patches(l, b, cell, patch, next, patches);
        memcpy(next, patches->first, (size_t)l->cell_count * sizeof *next);
        for (int64_t i = 0; i < m->points; ++i) /* roots come before what hangs on them; -1 - number marks those that have one */
            patch[i] = patch[i] == i ? (int32_t)(-1 - next[cell[i]]++) : patch[patch[i]];
        for (int64_t i = 0; i < m->points; ++i) patch[i] = -1 - patch[i];
    }
    peri__give_level(l, next, l->cell_count, sizeof *next);
    l->start = (int32_t *)peri__take_level(l, l->patches + 1, sizeof *l->start);
    l->order = (int32_t *)peri__take_level(l, m->points, sizeof *l->order);
    l->within = (float *)peri__take_level(l, m->points * l->dim, sizeof *l->within);
    l->given = (double *)peri__take_level(l, l->patches * l->dim << l->dim, sizeof *l->given);
    l->node = (int32_t *)peri__take_level(l, l->patches << l->dim, sizeof *l->node);
    if (!ok || !l->start || !l->order || !l->within || !l->given || !l->node) return 0;
    double within[3] = { 0.0 };
    for (int64_t i = 0; i < m->points; ++i) l->start[patch[i] + 1]++;
    for (int64_t p = 0; p < l->patches; ++p) l->start[p + 1] += l->start[p];
    for (int64_t i = m->points - 1; i >= 0; --i) { /* fills each patch from its end; starts shift down and are put back */
        const int32_t at = --l->start[patch[i] + 1];
        (void)peri__grid_cell(l, b, i, within);
        l->order[at] = (int32_t)i;
        for (int32_t d = 0; d < l->dim; ++d) l->within[at * l->dim + d] = (float)within[d];
    }
    for (int64_t p = 0; p < l->patches; ++p) l->start[p] = l->start[p + 1];
    l->start[l->patches] = (int32_t)m->points;
    return 1;
}

/* How many patches the cells beside a cell have. */
static int64_t peri__patches_beside(const peri__multilevel *l, const peri__mesh_level *patches, int64_t cell) {
    const int around = l->dim == 3 ? 27 : 9;
    int64_t count = 0;
    for (int o = 0; o < around; ++o) {
        int64_t other = 0, step = 1, rest = cell;
        int outside = 2 * o == around - 1;
        for (int d = 0, digit = o; d < l->dim; ++d, digit /= 3) {
            const int64_t place = rest % l->cells[d] + digit % 3 - 1;
            outside |= place < 0 || place >= l->cells[d];
            other += place * step;
            step *= l->cells[d];
            rest /= l->cells[d];
        }
        if (!outside) count += patches->first[other + 1] - patches->first[other];
    }
    return count;
}

static int peri__are_beside(const peri__multilevel *l, int64_t a, int64_t c) {
    for (int d = 0; d < l->dim; ++d) {
        if (a % l->cells[d] - c % l->cells[d] > 1 || c % l->cells[d] - a % l->cells[d] > 1) return 0;
        a /= l->cells[d];
        c /= l->cells[d];
    }
    return 1;
}

/* Appends to `patches` those that live bonds of point i, of patch p, lead to. linked[q] is the last patch, plus 1, that q was met from. */
static int peri__link_point(peri__multilevel *l, const peri_body *b, int64_t i, const int32_t *cell, const int32_t *patch, int32_t *linked,
                            int64_t *count, peri__mesh_level *patches) {
    const int32_t p = patch[i];
    peri__row row;
    peri__read_row(b, i, &row);
    for (int64_t k = 0; k < row.count; ++k) {
        const int32_t q = patch[row.ids[k]];
        if (q == p || linked[q] == p + 1 || !peri__is_alive(b, i, k) || !peri__are_beside(l, cell[i], cell[row.ids[k]])) continue;
        linked[q] = p + 1;
        if (!peri__grow(&l->memory, &patches->column, &patches->entries, *count + 1, sizeof *patches->column)) return 0;
        patches->column[(*count)++] = q;
    }
    return 1;
}

/* Which patches of cells beside each other live bonds link: the rows of `patches`, of which `entries` is the room. Points are looked at
   from both ends of a patch, until there is nothing left to find. */
static int peri__link_patches(peri__multilevel *l, const peri_body *b, const int32_t *cell, const int32_t *patch,
                              peri__mesh_level *patches) {
    int32_t *linked = (int32_t *)peri__take_level(l, l->patches, sizeof *linked);
    int64_t count = 0;
    patches->start = (int64_t *)peri__take_level(l, l->patches + 1, sizeof *patches->start);
    int ok = linked && patches->start;
    for (int32_t p = 0; ok && p < l->patches; ++p) {
        const int64_t size = l->start[p + 1] - l->start[p];
        const int64_t most = count + peri__patches_beside(l, patches, cell[l->order[l->start[p]]]);
        for (int64_t k = 0; ok && k < size && count < most; ++k) {
            const int64_t o = k % 2 ? l->start[p + 1] - 1 - k / 2 : l->start[p] + k / 2;
            ok = peri__link_point(l, b, l->order[o], cell, patch, linked, &count, patches);
        }
        patches->start[p + 1] = count;
    }
    l->bytes += patches->entries * (int64_t)sizeof *patches->column;
    peri__give_level(l, linked, l->patches, sizeof *linked);
    return ok;
}

/* ---- the finest level ------------------------------------------------------------------------------------------------ */
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

/* Adds what point o of the order is to the stiffness of the corners of its cell, dense[corners*dim][corners*dim], the upper triangle of
   corners alone. */
static void peri__add_point(const peri__solver *s, const peri__multilevel *l, int64_t o, double *dense) {
    const peri_body *b = s->body;
    const peri__model *m = b->model;
    const int64_t i = l->order[o];
    const peri__law *law = &m->laws[m->material[i]];
    const int dim = l->dim, corners = 1 << dim, wide = corners * dim;
    const double spring = s->inertia * peri__mass(b, i);
    const double volume = m->volume[i] * peri__relative_stiffness(b, i), lambda = volume * law->lambda, mu = volume * law->mu;
    double shape[8], gradient[8][3];
    for (int c = 0; c < corners; ++c) {
        double within[3] = { 0.0 };
        shape[c] = 1.0;
        for (int d = 0; d < dim; ++d) {
            within[d] = c >> d & 1 ? (double)l->within[o * dim + d] : 1.0 - (double)l->within[o * dim + d];
            shape[c] *= within[d];
        }
        for (int d = 0; d < dim; ++d) {
            gradient[c][d] = (c >> d & 1 ? 1.0 : -1.0) / l->spacing;
            for (int e = 0; e < dim; ++e)
                if (e != d) gradient[c][d] *= within[e];
        }
    }
    for (int a = 0; a < corners; ++a)
        for (int c = a; c < corners; ++c) {
            double *block = dense + (a * wide + c) * dim;
            const double dot = mu * peri__dot(gradient[a], gradient[c], dim);
            for (int p = 0; p < dim; ++p) {
                for (int q = 0; q < dim; ++q)
                    block[p * wide + q] += lambda * gradient[a][p] * gradient[c][q] + mu * gradient[a][q] * gradient[c][p];
                block[p * wide + p] += dot;
                if (s->constrained[i] >> p & 1)
                    block[p * wide + p] += shape[a] * shape[c] * peri__get_real(s->blocks, b->f32, p * m->stride + i);
                else if (spring > 0.0) block[p * wide + p] += shape[a] * shape[c] * spring;
            }
        }
}

/* The stiffness of the finest level, patch by patch. */
static void peri__assemble_finest(const peri__solver *s, peri__multilevel *l) {
    peri__mesh_level *v = &l->level[0];
    const int dim = l->dim, corners = 1 << dim, wide = corners * dim;
    for (int64_t p = 0; p < l->patches; ++p) {
        double dense[24 * 24] = { 0.0 };
        for (int64_t o = l->start[p]; o < l->start[p + 1]; ++o) peri__add_point(s, l, o, dense);
        for (int a = 0; a < corners; ++a)
            for (int c = 0; c < corners; ++c) {
                float *block = &v->block[peri__entry_of(v, l->node[p * corners + a], l->node[p * corners + c]) * dim * dim];
                for (int d = 0; d < dim; ++d)
                    for (int e = 0; e < dim; ++e)
                        block[d * dim + e] += (float)(a <= c ? dense[(a * dim + d) * wide + c * dim + e]
                                                             : dense[(c * dim + e) * wide + a * dim + d]);
            }
    }
}

/* Node of corner c (bit d: the upper one of axis d) of each patch: that of its nodes which is at the corner's site. */
static void peri__name_corners(peri__multilevel *l, const peri__mesh_level *patches, const peri__shares *up) {
    const peri__mesh_level *v = &l->level[0];
    const int dim = l->dim, corners = 1 << dim;
    for (int64_t cell = 0; cell < l->cell_count; ++cell)
        for (int c = 0; c < corners; ++c) {
            int64_t site = 0, step = 1, rest = cell;
            for (int d = 0; d < dim; ++d) {
                site += (rest % l->cells[d] + (c >> d & 1)) * step;
                rest /= l->cells[d];
                step *= v->sites[d];
            }
            for (int64_t p = patches->first[cell]; p < patches->first[cell + 1]; ++p) {
                int64_t e = up->start[p];
                while (up->node[e] < v->first[site] || up->node[e] >= v->first[site + 1]) ++e;
                l->node[p * corners + c] = up->node[e];
            }
        }
}

/* Cells, patches, and the nodes of the finest level with their stiffness. `patches` is dropped in the end. */
static int peri__build_finest(const peri__solver *s, peri__multilevel *l) {
    const peri_body *b = s->body;
    const int64_t points = b->model->points;
    peri__mesh_level patches, *v = &l->level[0];
    peri__shares down, up;
    memset(&patches, 0, sizeof patches);
    memset(&down, 0, sizeof down);
    memset(&up, 0, sizeof up);
    peri__lay_grid(l, b);
    int32_t *cell = (int32_t *)peri__take_level(l, points, sizeof *cell), *patch = (int32_t *)peri__take_level(l, points, sizeof *patch);
    int ok = cell && patch;
    double within[3] = { 0.0 };
    for (int64_t i = 0; ok && i < points; ++i) cell[i] = (int32_t)peri__grid_cell(l, b, i, within);
    ok = ok && peri__take_patches(l, b, cell, patch, &patches) && peri__link_patches(l, b, cell, patch, &patches);
    peri__give_level(l, cell, points, sizeof *cell);
    peri__give_level(l, patch, points, sizeof *patch);
    for (int32_t d = 0; d < l->dim; ++d) v->sites[d] = l->cells[d] + 1;
    ok = ok && peri__find_nodes(l, &patches, v, 1, &down) && peri__transpose_shares(l, &down, l->patches, &up);
    ok = ok && peri__take_rows(l, &patches, v, 1, &down, &up);
    if (ok) peri__name_corners(l, &patches, &up);
    peri__give_shares(l, &down);
    peri__give_shares(l, &up);
    peri__give_level(l, patches.first, patches.site_count + 1, sizeof *patches.first);
    peri__give_level(l, patches.start, l->patches + 1, sizeof *patches.start);
    peri__give_level(l, patches.column, patches.entries, sizeof *patches.column);
    if (!ok) return 0;
    peri__assemble_finest(s, l);
    l->levels = 1;
    return 1;
}

/* ---- between the points and the finest level ------------------------------------------------------------------------- */

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

/* What each patch gives to its corners of P^T r, the constrained components left out. dim and f32 are constants where this is inlined. */
PERI_INLINE void peri__restrict_some(const peri__transfer *t, int64_t begin, int64_t end, const int dim, const int f32) {
    const peri__multilevel *l = t->levels;
    const int corners = 1 << dim;
    const int64_t stride = t->solver->body->model->stride;
    const uint8_t *constrained = t->solver->constrained;
    for (int64_t p = begin; p < end; ++p) {
        double sum[24] = { 0.0 }, shape[8];
        for (int64_t o = l->start[p]; o < l->start[p + 1]; ++o) {
            const int64_t i = l->order[o];
            peri__shapes(l, o, dim, shape);
            for (int d = 0; d < dim; ++d) {
                if (constrained[i] >> d & 1) continue;
                const double r = peri__get_real(t->solver->k.r, f32, d * stride + i);
                for (int c = 0; c < corners; ++c) sum[c * dim + d] += shape[c] * r;
            }
        }
        memcpy(&l->given[p * corners * dim], sum, (size_t)(corners * dim) * sizeof *sum);
    }
}

static void peri__restrict_patches(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__transfer *t = (const peri__transfer *)context;
    const int f32 = t->solver->body->f32;
    (void)sums;
    if (t->levels->dim == 3) peri__restrict_some(t, begin, end, 3, f32);
    else peri__restrict_some(t, begin, end, 2, f32);
}

/* And the sum of what the nodes are given. */
static void peri__sum_patches(peri__multilevel *l) {
    peri__mesh_level *v = &l->level[0];
    const int dim = l->dim;
    memset(v->r, 0, (size_t)(v->count * dim) * sizeof *v->r);
    for (int64_t k = 0; k < l->patches << dim; ++k)
        for (int d = 0; d < dim; ++d) v->r[(int64_t)l->node[k] * dim + d] += l->given[k * dim + d];
}

/* z of the points of patches += P x of the nodes, but for what is constrained. */
PERI_INLINE void peri__prolong_some(const peri__transfer *t, int64_t begin, int64_t end, const int dim, const int f32) {
    const peri__multilevel *l = t->levels;
    const int corners = 1 << dim;
    const int64_t stride = t->solver->body->model->stride;
    const uint8_t *constrained = t->solver->constrained;
    void *z = t->solver->k.z;
    for (int64_t p = begin; p < end; ++p) {
        double x[24], shape[8];
        for (int c = 0; c < corners; ++c)
            memcpy(&x[c * dim], &l->level[0].x[(int64_t)l->node[p * corners + c] * dim], (size_t)dim * sizeof *x);
        for (int64_t o = l->start[p]; o < l->start[p + 1]; ++o) {
            const int64_t i = l->order[o];
            peri__shapes(l, o, dim, shape);
            for (int d = 0; d < dim; ++d) {
                const int64_t at = d * stride + i;
                double sum = 0.0;
                if (constrained[i] >> d & 1) continue;
                for (int c = 0; c < corners; ++c) sum += shape[c] * x[c * dim + d];
                peri__put_real(z, f32, at, peri__get_real(z, f32, at) + sum);
            }
        }
    }
}

static void peri__prolong_patches(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__transfer *t = (const peri__transfer *)context;
    const int f32 = t->solver->body->f32;
    (void)sums;
    if (t->levels->dim == 3) peri__prolong_some(t, begin, end, 3, f32);
    else peri__prolong_some(t, begin, end, 2, f32);
}

/* Builds the levels for the body as it is; s->blocks are the diagonal blocks, not yet inverted. NULL where memory is short. */
static peri__multilevel *peri__build_levels(const peri__solver *s) {
    const peri_body *b = s->body;
    const peri__memory memory = s->kept ? peri__lasting(b) : b->scratch;
    peri__multilevel *l = (peri__multilevel *)peri__new(&memory, 1, sizeof *l);
    if (!l) return NULL;
    l->memory = memory;
    l->dim = b->dim;
    l->bytes = (int64_t)sizeof *l;
    int ok = peri__build_finest(s, l);
    while (ok > 0 && l->levels < PERI_LEVELS && l->level[l->levels - 1].count * l->dim > PERI_DENSE) ok = peri__coarsen(l, b);
    if (ok && peri__factor_coarsest(l, b)) return l;
    peri__free_levels(l);
    return NULL;
}

/* z += P B P^T r */
static void peri__correct_coarsely(const peri__solver *s) {
    peri__transfer t;
    t.solver = s;
    t.levels = s->levels;
    peri__for_points(s->body, t.levels->patches, 100, peri__restrict_patches, &t, NULL);
    peri__sum_patches(t.levels);
    peri__cycle(t.levels, s->body, 0);
    peri__for_points(s->body, t.levels->patches, 100, peri__prolong_patches, &t, NULL);
}
