/* SPDX-License-Identifier: MIT */
/* estimate.c - a body that is only described: a box of cells, one material. Its counts are those of the body to be, found without making
   its points; its pointers say which arrays there would be and point nowhere. So what it would hold is counted by the function that counts
   a real body, and whether two points share a bond, and what that weighs, is asked of the functions that build one.

   Families. On a lattice, point p has the bond v where v is within reach and p + v within the box: prod(n_d - |v_d|) of the points do. A
   moved point has it with a probability, taken over the place of the neighbour relative to its own.

   Columns. A group of PERI_GROUP points in a row of ids has a column for each v that any of them has. Rows are n_0 long, so where groups
   lie in them repeats every PERI_GROUP rows: what is counted here are kinds of rows, and how many there are of each. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#define PERI_SAMPLES_2D 8 /* places of a moved neighbour per axis                                                         */
#define PERI_SAMPLES_3D 4

typedef struct peri__estimate { /* 60 kB, on the stack of peri_plan: it allocates nothing                                */
    peri_body     body;
    peri__model   model;
    peri__piece   piece;
    peri__cloud   cloud;
    peri__partial_volumes   parts;
    peri__pair    pair;
    double        x[6], volume[2]; /* two points, the first at 0                                                         */
    uint8_t       material[2];
    int32_t       axis[3];         /* the longest first                                                                  */
    int64_t       n[3];            /* cells per axis; 1 in the third of 2D                                               */
    double        jitter;          /* by how many cells a neighbour may be off its site, each way                        */
    int64_t       span[3];         /* the longest bond along each axis, in cells                                         */
    int64_t       bonds, width;
    double        vectors;         /* lattice vectors of bonds                                                           */
    int64_t       vector_count;    /* those in `vector`: all, or 0 where they are too many                               */
    int32_t       vector[PERI_VECTOR_LIMIT][3];
    double        length[PERI_VECTOR_LIMIT], weight[PERI_VECTOR_LIMIT];
    int32_t       corrected;       /* 1: the weights of bonds depend on where their ends are                             */
} peri__estimate;

/* Would the point at xi, in cells, be in the family of the point at 0? Falls with each |xi_d|. */
static int peri__joins(peri__estimate *s, const double *xi) {
    const int32_t dim = s->model.dim;
    double square = 0.0;
    for (int32_t d = 0; d < dim; ++d) {
        s->x[dim + d] = xi[d] * (s->piece.cell[d] / s->model.length);
        square += peri__square(s->x[dim + d]);
    }
    return square <= s->cloud.reach2 && peri__is_family(&s->cloud, 0, 1);
}

/* The largest a >= 0 below n such that the site (a, p, q) by s->axis, moved out by `out` cells on each axis, joins; -1 where none does. */
static int64_t peri__extent(peri__estimate *s, int64_t p, int64_t q, double out) {
    const int64_t site[3] = { 0, p, q };
    int64_t lo = -1, hi = s->n[s->axis[0]];
    while (hi - lo > 1) {
        const int64_t mid = lo + (hi - lo) / 2;
        double xi[3] = { 0.0, 0.0, 0.0 };
        for (int k = 0; k < 3; ++k) {
            const double place = (double)(k == 0 ? mid : site[k]) + (s->n[s->axis[k]] > 1 ? out : 0.0);
            xi[s->axis[k]] = place > 0.0 ? place : 0.0;
        }
        if (peri__joins(s, xi)) lo = mid;
        else hi = mid;
    }
    return lo;
}

/* How probably the neighbour at site (a, p, q) by s->axis joins. */
static double peri__chance(peri__estimate *s, int64_t a, int64_t p, int64_t q) {
    const int64_t site[3] = { a, p, q };
    const int dim = s->model.dim, steps = dim == 3 ? PERI_SAMPLES_3D : PERI_SAMPLES_2D, all = steps * steps * (dim == 3 ? steps : 1);
    int joined = 0;
    for (int k = 0; k < all; ++k) {
        double xi[3] = { 0.0, 0.0, 0.0 };
        for (int d = 0, rest = k; d < 3; ++d) {
            if (s->axis[d] >= dim) continue;
            xi[s->axis[d]] = (double)site[d] + s->jitter * ((2.0 * (rest % steps) + 1.0) / steps - 1.0);
            rest /= steps;
        }
        joined += peri__joins(s, xi);
    }
    return (double)joined / all;
}

/* Signs of v that stay in the box, seen from its middle. */
static int64_t peri__sides(int64_t v, int64_t n) {
    const int64_t before = (n - 1) / 2;
    return v == 0 ? 1 : (v <= before) + (v <= n - 1 - before);
}

/* Bonds, the largest family, and the lattice vectors. */
static void peri__count_bonds(peri__estimate *s) {
    const int64_t n0 = s->n[s->axis[0]], n1 = s->n[s->axis[1]], n2 = s->n[s->axis[2]], before = (n0 - 1) / 2;
    int64_t bonds = 0, width = 0;
    double parts = 0.0, mean = 0.0, spread = 0.0, vectors = 0.0;
    memset(s->span, 0, sizeof s->span);
    for (int64_t q = 0; q < n2; ++q) {
        int64_t p = 0;
        for (; p < n1; ++p) {
            const int64_t in = peri__extent(s, p, q, s->jitter), out = s->jitter > 0.0 ? peri__extent(s, p, q, -s->jitter) : in;
            const int64_t copies = (p > 0 ? 2 : 1) * (q > 0 ? 2 : 1), places = (n1 - p) * (n2 - q);
            const int64_t sides = peri__sides(p, n1) * peri__sides(q, n2);
            if (out < 0) break;
            if (out > s->span[s->axis[0]]) s->span[s->axis[0]] = out;
            if (p > s->span[s->axis[1]]) s->span[s->axis[1]] = p;
            if (q > s->span[s->axis[2]]) s->span[s->axis[2]] = q;
            vectors += (double)copies * (2.0 * (double)out + 1.0);
            if (in >= 0) {
                bonds += copies * places * (n0 + in * (2 * n0 - in - 1)); /* no part of it passes points^2 < 2^62 */
                width += sides * (1 + peri__min(in, before) + peri__min(in, n0 - 1 - before));
            }
            for (int64_t a = in + 1; a <= out; ++a) {
                const double chance = a + p + q > 0 ? peri__chance(s, a, p, q) : 1.0; /* oneself is no chance */
                const double seen = (double)(peri__sides(a, n0) * sides);
                parts += chance * (double)((a > 0 ? 2 : 1) * copies) * (double)(n0 - a) * (double)places;
                mean += chance * seen;
                spread += chance * (1.0 - chance) * seen;
            }
        }
        if (p == 0) break;
    }
    s->bonds = bonds + (int64_t)(parts + 0.5) - s->model.points;
    s->width = peri__min(width + (int64_t)(mean + 4.0 * sqrt(spread) + 0.5), s->model.points) - 1; /* the largest of many families */
    s->vectors = vectors - 1.0;
}

/* The lattice vectors, where there is room for them. */
static void peri__list_vectors(peri__estimate *s) {
    int64_t count = 0;
    s->vector_count = 0;
    if (s->vectors <= 4.0 * PERI_VECTOR_LIMIT)
        for (int64_t z = -s->span[2]; z <= s->span[2]; ++z)
            for (int64_t y = -s->span[1]; y <= s->span[1]; ++y)
                for (int64_t x = -s->span[0]; x <= s->span[0]; ++x) {
                    const double xi[3] = { (double)x, (double)y, (double)z };
                    if ((x == 0 && y == 0 && z == 0) || !peri__joins(s, xi)) continue;
                    if (count < PERI_VECTOR_LIMIT) {
                        s->vector[count][0] = (int32_t)x;
                        s->vector[count][1] = (int32_t)y;
                        s->vector[count][2] = (int32_t)z;
                    }
                    count++;
                }
    if (count <= PERI_VECTOR_LIMIT) s->vector_count = count;
}

/* ---- columns ------------------------------------------------------------------------------------------------------ */

/* Numbers in [first, first + count) that are r modulo PERI_GROUP. */
static int64_t peri__count_like(int64_t first, int64_t count, int64_t r) {
    const int64_t skip = ((r - first) % PERI_GROUP + PERI_GROUP) % PERI_GROUP;
    return count > skip ? (count - skip - 1) / PERI_GROUP + 1 : 0;
}

/* Groups with a point that has the bond v. Those points are runs of ids, one in each of some rows; a group that holds the end of one run
   and the start of the next counts once. */
static int64_t peri__groups_of(const peri__estimate *s, const int32_t *v) {
    int64_t first[3], count[3], total = 0;
    for (int d = 0; d < 3; ++d) {
        first[d] = v[d] < 0 ? -v[d] : 0;
        count[d] = s->n[d] - (v[d] < 0 ? -v[d] : v[d]);
        if (count[d] <= 0) return 0;
    }
    const int64_t skipped = s->n[1] - count[1] + 1, last = first[1] + count[1] - 1;
    for (int64_t z = 0; z < PERI_GROUP; ++z) {
        const int64_t slabs = peri__count_like(first[2], count[2], z), before_slab = peri__count_like(first[2], count[2] - 1, z);
        for (int64_t y = 0; y < PERI_GROUP && slabs > 0; ++y) {
            const int64_t rows = peri__count_like(first[1], count[1], y), before_row = peri__count_like(first[1], count[1] - 1, y);
            const int64_t start = ((y + s->n[1] * z) % PERI_GROUP * s->n[0] + first[0]) % PERI_GROUP;
            const int64_t end = (start + count[0] - 1) / PERI_GROUP;
            total += slabs * (rows * (end + 1) - before_row * (end == (start + s->n[0]) / PERI_GROUP));
            if (last % PERI_GROUP == y) total -= before_slab * (end == (start + skipped * s->n[0]) / PERI_GROUP);
        }
    }
    return total;
}

/* Columns of the group that starts at x0 in row (y, z). Corrected weights of bonds within `margin` of a face across the row differ. */
static int64_t peri__group_columns(const peri__estimate *s, int64_t x0, int64_t y, int64_t z, int64_t margin) {
    int64_t columns = 0;
    for (int64_t k = 0; k < s->vector_count; ++k) {
        const int32_t *v = s->vector[k];
        int64_t has = 0, plain = 0, lane = 0, row = y, slab = z;
        for (int64_t x = x0; lane < PERI_GROUP && slab < s->n[2]; x = 0) {
            const int64_t end = peri__min(s->n[0] - 1, x + PERI_GROUP - 1 - lane);
            int64_t lo = v[0] < 0 ? -v[0] : 0, hi = s->n[0] - 1 - (v[0] > 0 ? v[0] : 0);
            if (lo < x) lo = x;
            if (hi > end) hi = end;
            if (lo <= hi && row + v[1] >= 0 && row + v[1] < s->n[1] && slab + v[2] >= 0 && slab + v[2] < s->n[2]) {
                const int64_t shift = v[0] < 0 ? -v[0] : 0, reach = v[0] < 0 ? 0 : v[0];
                for (int64_t at = lo; margin > 0 && at <= hi; ++at) {
                    if (at - shift < margin || at + reach > s->n[0] - 1 - margin) has++;
                    else plain = 1;
                }
                if (margin == 0) plain = 1;
            }
            lane += end - x + 1;
            if (++row == s->n[1]) {
                row = 0;
                slab++;
            }
        }
        columns += has + plain;
    }
    return columns;
}

/* Indices on an axis of n, by kind: those within k of the lower and k + further of the upper end, each by itself, and all others. */
static int64_t peri__kinds(int64_t n, int64_t k, int64_t further) { return n <= 2 * k + further ? n : 2 * k + further + 1; }

static void peri__kind(int64_t n, int64_t k, int64_t further, int64_t kind, int64_t *first, int64_t *count) {
    const int64_t kinds = peri__kinds(n, k, further);
    *first = kinds == n || kind <= k ? kind : n - kinds + kind;
    *count = kinds < n && kind == k ? n - 2 * k - further : 1;
}

/* Columns of the kinds of groups that start at x0: one group of each is looked for. The rows of a kind act alike up to `rows` rows on. */
static int64_t peri__columns_from(const peri__estimate *s, int64_t x0, int64_t x1, const int64_t *rim, int64_t margin) {
    const int64_t rows = (x0 + PERI_GROUP - 1) / s->n[0];
    int64_t total = 0;
    for (int64_t p = 0; p < peri__kinds(s->n[1], rim[1], rows); ++p) {
        int64_t y0, ys, z0, zs;
        peri__kind(s->n[1], rim[1], rows, p, &y0, &ys);
        const int64_t slabs = ys == 1 ? (y0 + rows) / s->n[1] : 0;
        for (int64_t q = 0; q < peri__kinds(s->n[2], rim[2], slabs); ++q) {
            int64_t found = 0;
            peri__kind(s->n[2], rim[2], slabs, q, &z0, &zs);
            for (int64_t k = 0; k < PERI_GROUP * PERI_GROUP && !found; ++k) {
                const int64_t y = y0 + k % PERI_GROUP, z = z0 + k / PERI_GROUP;
                for (int64_t x = x0; x <= x1 && y < y0 + ys && z < z0 + zs && !found; ++x) {
                    if (((y + s->n[1] * z) % PERI_GROUP * s->n[0] + x) % PERI_GROUP != 0) continue;
                    total += peri__group_columns(s, x, y, z, margin);
                    found = 1;
                }
            }
        }
    }
    return total;
}

/* Columns of all groups that differ. Groups away from the ends of a row are alike wherever they start. */
static int64_t peri__kept_columns(const peri__estimate *s, int64_t margin) {
    const int64_t last = s->n[0] - 1;
    int64_t rim[3], total = 0;
    for (int d = 0; d < 3; ++d) rim[d] = s->corrected ? 2 * s->span[d] : s->span[d];
    const int64_t inner = rim[0], inner_last = last - rim[0] - (PERI_GROUP - 1);
    if (inner <= inner_last) total = peri__columns_from(s, inner, peri__min(inner_last, inner + PERI_GROUP - 1), rim, margin);
    for (int64_t x0 = 0; x0 <= last; ++x0) {
        if (x0 >= inner && x0 <= inner_last) x0 = inner_last + 1;
        total += peri__columns_from(s, x0, x0, rim, margin);
    }
    return total;
}

/* Lays the families by columns where peri__build_stencil would. 1: done; 0: tried in vain; -1: not tried. */
static int peri__estimate_stencil(peri__estimate *s) {
    const peri_body_desc *desc = &s->body.desc;
    peri__stencil *l = &s->model.stencil;
    peri__model *m = &s->model;
    double rows = 0.0;
    if (desc->quadrature == PERI_QUADRATURE_PARTIAL_CENTROID || (s->corrected && !m->pairwise)
        || desc->correction == PERI_CORRECTION_EQUILIBRIUM) return -1;
    if (desc->kernel != PERI_KERNEL_BEST) return -1;
    if (s->jitter > 0.0 || s->vector_count == 0 || s->width > PERI_VECTOR_LIMIT) return 0;
    l->groups = (m->points + PERI_GROUP - 1) / PERI_GROUP;
    l->vectors = (int32_t)s->vector_count;
    for (int64_t k = 0; k < s->vector_count; ++k) {
        const int32_t *v = s->vector[k];
        const int64_t offset = v[0] + s->n[0] * (v[1] + s->n[1] * v[2]);
        double kinds = m->dim == 3 ? 0.25 : 0.375; /* symmetry makes some alike: as boxes have it */
        for (int d = 0; d < 3; ++d) kinds *= (double)peri__min(s->n[d], 2 * s->span[d] + 1);
        l->columns += peri__groups_of(s, v);
        if (offset > l->reach) l->reach = offset;
        if (s->corrected) rows += kinds;
    }
    const int64_t margin = s->corrected ? s->span[0] : 0;
    if (s->corrected) {
        l->columns += (int64_t)(0.7 * (double)peri__min(2 * margin, s->n[0]) * (double)s->bonds / (double)s->n[0]);
        l->vectors = rows < 2.0 * PERI_VECTOR_LIMIT ? (int32_t)rows : 2 * PERI_VECTOR_LIMIT;
    }
    if (l->vectors > PERI_VECTOR_LIMIT || 5 * s->bonds < 2 * PERI_GROUP * l->columns) {
        memset(l, 0, sizeof *l);
        return 0;
    }
    l->kept = peri__kept_columns(s, margin);
    return 1;
}
