/* SPDX-License-Identifier: MIT */
/* coarsen.c - the next level: which nodes it has, which it joins, and its stiffness P^T A P.

   The nodes of a site are the connected components of what lies under its shape function: of the patches of cells, for the finest level,
   of nodes for the others. Sides of a crack that goes through all of that are apart, and so is their motion; where it ends within, they
   hang together round its tip, and one node does. Each of what is below takes a site's share from the one node that it belongs to, so that
   the weights of every node sum to 1 and rigid-body motions are passed exactly. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

typedef struct peri__joiner { /* scratch, each as long as there are nodes below                                           */
    int32_t *member, *part, *root, *mark; /* under the shape function: nodes, their component; mark: place among them + 1 */
    float   *weight;
    int64_t  members;
} peri__joiner;

static int peri__take_joiner(peri__multilevel *l, peri__joiner *j, int64_t nodes) {
    memset(j, 0, sizeof *j);
    j->member = (int32_t *)peri__take_level(l, nodes, sizeof *j->member);
    j->part = (int32_t *)peri__take_level(l, nodes, sizeof *j->part);
    j->root = (int32_t *)peri__take_level(l, nodes, sizeof *j->root);
    j->mark = (int32_t *)peri__take_level(l, nodes, sizeof *j->mark);
    j->weight = (float *)peri__take_level(l, nodes, sizeof *j->weight);
    return j->member && j->part && j->root && j->mark && j->weight;
}

static void peri__give_joiner(peri__multilevel *l, peri__joiner *j, int64_t nodes) {
    peri__give_level(l, j->member, nodes, sizeof *j->member);
    peri__give_level(l, j->part, nodes, sizeof *j->part);
    peri__give_level(l, j->root, nodes, sizeof *j->root);
    peri__give_level(l, j->mark, nodes, sizeof *j->mark);
    peri__give_level(l, j->weight, nodes, sizeof *j->weight);
}

static int32_t peri__root_among(int32_t *root, int32_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
}

/* Returns 1 where they were apart. The least stays the root. */
static int peri__join_roots(int32_t *root, int32_t a, int32_t b) {
    a = peri__root_among(root, a);
    b = peri__root_among(root, b);
    if (a < b) root[b] = a;
    if (b < a) root[a] = b;
    return a != b;
}

/* The components of the members, numbered by their first; returns how many. */
static int32_t peri__join(const peri__mesh_level *fine, peri__joiner *j) {
    int32_t parts = 0;
    for (int32_t k = 0; k < j->members; ++k) {
        j->mark[j->member[k]] = k + 1;
        j->root[k] = k;
    }
    for (int32_t k = 0; k < j->members; ++k)
        for (int64_t e = fine->start[j->member[k]]; e < fine->start[j->member[k] + 1]; ++e)
            if (j->mark[fine->column[e]] > k + 1) (void)peri__join_roots(j->root, k, j->mark[fine->column[e]] - 1);
    for (int32_t k = 0; k < j->members; ++k) {
        const int32_t root = peri__root_among(j->root, k);
        j->part[k] = root == k ? parts++ : j->part[root];
        j->mark[j->member[k]] = 0;
    }
    return parts;
}

/* What lies under the shape function of a site of the next level: nodes at up to a site beside twice its place; or, over `cells`, the
   patches of the cells around it. */
static void peri__gather_members(const peri__mesh_level *fine, const peri__mesh_level *coarse, int dim, int cells, int64_t site,
                                 peri__joiner *j) {
    const int wide = cells ? 2 : 3, all = dim == 3 ? wide * wide * wide : wide * wide;
    int64_t at[3] = { 0, 0, 0 };
    for (int d = 0; d < dim; ++d) {
        at[d] = site % coarse->sites[d];
        site /= coarse->sites[d];
    }
    j->members = 0;
    for (int o = 0; o < all; ++o) {
        int64_t child = 0, step = 1;
        float weight = 1.0f;
        int outside = 0;
        for (int d = 0, rest = o; d < dim; ++d, rest /= wide) {
            const int64_t place = (cells ? at[d] : 2 * at[d]) + rest % wide - 1;
            outside |= place < 0 || place >= fine->sites[d];
            if (!cells && rest % wide != 1) weight *= 0.5f;
            child += place * step;
            step *= fine->sites[d];
        }
        for (int64_t n = outside ? 0 : fine->first[child]; !outside && n < fine->first[child + 1]; ++n) {
            j->weight[j->members] = weight;
            j->member[j->members++] = (int32_t)n;
        }
    }
}

/* The nodes of the next level: coarse->first and count, and `down`, what lies under each. */
static int peri__find_nodes(peri__multilevel *l, const peri__mesh_level *fine, peri__mesh_level *coarse, int cells, peri__shares *down) {
    peri__joiner j;
    int64_t entries = 0;
    coarse->site_count = 1;
    for (int32_t d = 0; d < l->dim; ++d) coarse->site_count *= coarse->sites[d];
    coarse->first = (int64_t *)peri__take_level(l, coarse->site_count + 1, sizeof *coarse->first);
    int ok = peri__take_joiner(l, &j, fine->count) && coarse->first;
    for (int64_t s = 0; ok && s < coarse->site_count; ++s) {
        peri__gather_members(fine, coarse, l->dim, cells, s, &j);
        coarse->first[s + 1] = coarse->first[s] + peri__join(fine, &j);
        entries += j.members;
    }
    if (ok) coarse->count = coarse->first[coarse->site_count];
    ok = ok && peri__take_shares(l, down, coarse->count, entries);
    for (int64_t s = 0, e = 0; ok && s < coarse->site_count; ++s) {
        peri__gather_members(fine, coarse, l->dim, cells, s, &j);
        const int32_t parts = peri__join(fine, &j);
        for (int32_t p = 0; p < parts; ++p) {
            for (int32_t k = 0; k < j.members; ++k) {
                if (j.part[k] != p) continue;
                down->node[e] = j.member[k];
                down->weight[e++] = j.weight[k];
            }
            down->start[coarse->first[s] + p + 1] = e;
        }
    }
    peri__give_joiner(l, &j, fine->count);
    return ok;
}

/* `up` from `down`. */
static int peri__transpose_shares(peri__multilevel *l, const peri__shares *down, int64_t rows, peri__shares *up) {
    if (!peri__take_shares(l, up, rows, down->entries)) return 0;
    for (int64_t e = 0; e < down->entries; ++e) up->start[down->node[e] + 1]++;
    for (int64_t k = 0; k < rows; ++k) up->start[k + 1] += up->start[k];
    for (int64_t n = down->rows - 1; n >= 0; --n) /* fills each row from its end; starts shift down and are put back */
        for (int64_t e = down->start[n + 1] - 1; e >= down->start[n]; --e) {
            const int64_t at = --up->start[down->node[e] + 1];
            up->node[at] = (int32_t)n;
            up->weight[at] = down->weight[e];
        }
    for (int64_t k = 0; k < rows; ++k) up->start[k] = up->start[k + 1];
    up->start[rows] = up->entries;
    return 1;
}

static void peri__sort_columns(int32_t *column, int64_t count) {
    for (int64_t k = 1; k < count; ++k) {
        const int32_t value = column[k];
        int64_t at = k;
        for (; at > 0 && column[at - 1] > value; --at) column[at] = column[at - 1];
        column[at] = value;
    }
}

/* The columns of row n of the next level: all that share something with what lies under its node, or beside that unless it is a patch.
   Marked columns hold n + 1. Returns their number; writes them where `out` is not NULL. */
static int64_t peri__row_columns(const peri__mesh_level *fine, const peri__shares *down, const peri__shares *up, int cells, int64_t n,
                                 int32_t *mark, int32_t *out) {
    int64_t count = 0;
    for (int64_t e = down->start[n]; e < down->start[n + 1]; ++e) {
        const int32_t a = down->node[e];
        for (int64_t f = cells ? 0 : fine->start[a]; f < (cells ? 1 : fine->start[a + 1]); ++f) {
            const int32_t b = cells ? a : fine->column[f];
            for (int64_t g = up->start[b]; g < up->start[b + 1]; ++g) {
                if (mark[up->node[g]] == (int32_t)n + 1) continue;
                mark[up->node[g]] = (int32_t)n + 1;
                if (out) out[count] = up->node[g];
                ++count;
            }
        }
    }
    return count;
}

/* The rows of the next level, and what else it is made of. */
static int peri__take_rows(peri__multilevel *l, const peri__mesh_level *fine, peri__mesh_level *coarse, int cells, const peri__shares *down,
                           const peri__shares *up) {
    const int64_t n = coarse->count * l->dim;
    int32_t *mark = (int32_t *)peri__take_level(l, coarse->count, sizeof *mark);
    coarse->start = (int64_t *)peri__take_level(l, coarse->count + 1, sizeof *coarse->start);
    int ok = mark && coarse->start;
    for (int64_t k = 0; ok && k < coarse->count; ++k)
        coarse->start[k + 1] = coarse->start[k] + peri__row_columns(fine, down, up, cells, k, mark, NULL);
    if (ok) {
        coarse->entries = coarse->start[coarse->count];
        coarse->column = (int32_t *)peri__take_level(l, coarse->entries, sizeof *coarse->column);
        memset(mark, 0, (size_t)coarse->count * sizeof *mark);
    }
    ok = ok && coarse->column;
    for (int64_t k = 0; ok && k < coarse->count; ++k) {
        int32_t *row = coarse->column + coarse->start[k];
        peri__sort_columns(row, peri__row_columns(fine, down, up, cells, k, mark, row));
    }
    peri__give_level(l, mark, coarse->count, sizeof *mark);
    if (!ok) return 0;
    coarse->block = (float *)peri__take_level(l, coarse->entries * l->dim * l->dim, sizeof *coarse->block);
    coarse->inverse = (float *)peri__take_level(l, n * l->dim, sizeof *coarse->inverse);
    coarse->x = (double *)peri__take_level(l, n, sizeof *coarse->x);
    coarse->r = (double *)peri__take_level(l, n, sizeof *coarse->r);
    coarse->step = (double *)peri__take_level(l, n, sizeof *coarse->step);
    coarse->product = (double *)peri__take_level(l, n, sizeof *coarse->product);
    return coarse->block && coarse->inverse && coarse->x && coarse->r && coarse->step && coarse->product;
}

#define PERI_ROW_PART 32 /* columns of a row that are summed at a time                                                    */

/* coarse block = P^T block P, row by row. */
static void peri__galerkin(void *context, int64_t begin, int64_t end, peri__sums *sums) {
    const peri__level_task *t = (const peri__level_task *)context;
    const peri__mesh_level *f = t->fine, *c = t->coarse;
    const peri__shares *down = &f->down, *up = &f->up;
    const int size = t->l->dim * t->l->dim;
    (void)sums;
    for (int64_t n = begin; n < end; ++n)
        for (int64_t from = c->start[n]; from < c->start[n + 1]; from += PERI_ROW_PART) {
            const int64_t to = peri__min(from + PERI_ROW_PART, c->start[n + 1]);
            double sum[PERI_ROW_PART * 9] = { 0.0 };
            for (int64_t e = down->start[n]; e < down->start[n + 1]; ++e)
                for (int64_t k = f->start[down->node[e]]; k < f->start[down->node[e] + 1]; ++k)
                    for (int64_t g = up->start[f->column[k]]; g < up->start[f->column[k] + 1]; ++g) {
                        const double share = (double)down->weight[e] * (double)up->weight[g];
                        int64_t at = from;
                        while (at < to && c->column[at] < up->node[g]) ++at;
                        if (at == to || c->column[at] != up->node[g]) continue;
                        for (int p = 0; p < size; ++p) sum[(at - from) * size + p] += share * (double)f->block[k * size + p];
                    }
            for (int64_t k = 0; k < (to - from) * size; ++k) c->block[from * size + k] = (float)sum[k];
        }
}

/* Adds the next coarser level. Returns 1, 0 where memory is short, and -1 where there is none that is much smaller. */
static int peri__coarsen(peri__multilevel *l, const peri_body *b) {
    peri__mesh_level *fine = &l->level[l->levels - 1], *coarse = fine + 1;
    peri__level_task t;
    for (int32_t d = 0; d < l->dim; ++d) coarse->sites[d] = fine->sites[d] / 2 + 1;
    if (!peri__find_nodes(l, fine, coarse, 0, &fine->down)) return 0;
    if (10 * coarse->count > 9 * fine->count) {
        peri__give_shares(l, &fine->down);
        peri__give_level(l, coarse->first, coarse->site_count + 1, sizeof *coarse->first);
        memset(coarse, 0, sizeof *coarse);
        return -1;
    }
    if (!peri__transpose_shares(l, &fine->down, fine->count, &fine->up)) return 0;
    if (!peri__take_rows(l, fine, coarse, 0, &fine->down, &fine->up)) return 0;
    memset(&t, 0, sizeof t);
    t.l = l;
    t.fine = fine;
    t.coarse = coarse;
    peri__for_points(b, coarse->count, l->dim == 3 ? 7290 : 810, peri__galerkin, &t, NULL);
    l->levels++;
    peri__prepare_level(l, b, fine);
    return 1;
}
