/* SPDX-License-Identifier: MIT */
/* cell_mesh.h - meshes of a square or a cube [0, side]^dim: a grid whose inner vertices are moved at random, cut into cells of one kind. */
#ifndef CELL_MESH_H
#define CELL_MESH_H

#include "solid.h"

/* Spacing 1, no correction. */
static inline solid solid_with(int dim, int32_t law, int32_t quadrature, double horizon) {
    solid s = solid_of(dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, law, PERI_CORRECTION_NONE);
    s.quadrature = quadrature;
    s.spacing = 1;
    s.ratio = horizon;
    return s;
}

enum { QUADS, TRIANGLES, HOOKS, TETRAHEDRA, WEDGES, HEXAHEDRA, MESH_KINDS };
static const char *const mesh_name[MESH_KINDS] = {"quadrilaterals", "triangles", "hooks", "tetrahedra", "wedges", "hexahedra"};

typedef struct cell_mesh {
    int      kind, dim, side;
    int64_t  vertices, cells, total;
    double  *x;
    int32_t *corner;
    int64_t *offset;
} cell_mesh;

static inline void mesh_free(cell_mesh *m) {
    free(m->x);
    free(m->corner);
    free(m->offset);
    memset(m, 0, sizeof *m);
}

static inline void mesh_add(cell_mesh *m, int corners, const int32_t *of) {
    memcpy(&m->corner[m->total], of, (size_t)corners * sizeof *of);
    m->offset[++m->cells] = m->total += corners;
}

/* Of the grid cell at `at` those of its kind; c: its vertices in the order of VTK. */
static inline void mesh_cut(cell_mesh *m, const int32_t *c, int odd) {
    static const int path[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}; /* round the diagonal from 0 to 6 */
    int32_t out[8];
    int k;
    if (m->kind == QUADS) mesh_add(m, 4, c);
    if (m->kind == HEXAHEDRA) mesh_add(m, 8, c);
    for (k = 0; m->kind == TRIANGLES && k < 2; ++k) {
        out[0] = c[odd], out[1] = c[odd + 1 + k], out[2] = c[(odd + 2 + k) % 4];
        mesh_add(m, 3, out);
    }
    for (k = 0; m->kind == TETRAHEDRA && k < 6; ++k) {
        out[0] = c[0], out[1] = c[path[k][0]], out[2] = c[path[k][1]], out[3] = c[6];
        mesh_add(m, 4, out);
    }
    for (k = 0; m->kind == WEDGES && k < 2; ++k) {
        static const int half[2][6] = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
        for (int n = 0; n < 6; ++n) out[n] = c[half[k][n]];
        mesh_add(m, 6, out);
    }
}

/* Two hooks in a cell, not convex: the cell is divided along a line with two bends. */
static inline void mesh_hooks(cell_mesh *m, const int32_t *c) {
    const int32_t low = (int32_t)m->vertices, high = low + 1, first[6] = {c[0], c[1], low, high, c[2], c[3]};
    const int32_t second[4] = {c[1], c[2], high, low};
    for (int d = 0; d < 2; ++d) {
        m->x[2 * low + d] = 0.6 * m->x[2 * c[0] + d] + 0.4 * m->x[2 * c[1] + d] + 0.3 * (m->x[2 * c[3] + d] - m->x[2 * c[0] + d]);
        m->x[2 * high + d] = 0.6 * m->x[2 * c[3] + d] + 0.4 * m->x[2 * c[2] + d] + 0.3 * (m->x[2 * c[0] + d] - m->x[2 * c[3] + d]);
    }
    m->vertices += 2;
    mesh_add(m, 6, first);
    mesh_add(m, 4, second);
}

/* side^dim grid cells of edge 1; inner vertices move by up to `move` per axis. */
static inline cell_mesh mesh_of(int kind, int side, double move, uint64_t seed) {
    cell_mesh m;
    int64_t grid, cell, v;
    memset(&m, 0, sizeof m);
    m.kind = kind;
    m.dim = kind < TETRAHEDRA ? 2 : 3;
    m.side = side;
    grid = (int64_t)(side + 1) * (side + 1) * (m.dim == 3 ? side + 1 : 1);
    cell = (int64_t)side * side * (m.dim == 3 ? side : 1);
    m.x = (double *)malloc((size_t)(grid + 2 * cell) * (size_t)m.dim * sizeof *m.x);
    m.corner = (int32_t *)malloc((size_t)cell * 24 * sizeof *m.corner);
    m.offset = (int64_t *)calloc((size_t)cell * 6 + 1, sizeof *m.offset);
    m.vertices = grid;
    for (v = 0; v < grid; ++v) {
        int64_t rest = v, at[3];
        int d, inside = 1;
        for (d = 0; d < m.dim; ++d, rest /= side + 1) {
            at[d] = rest % (side + 1);
            inside = inside && at[d] > 0 && at[d] < side;
        }
        for (d = 0; d < m.dim; ++d) {
            const double by = move * (2 * test_random(&seed) - 1);
            m.x[v * m.dim + d] = (double)at[d] + (inside ? by : 0);
        }
    }
    for (v = 0; v < cell; ++v) {
        const int64_t i = v % side, j = v / side % side, k = v / side / side, row = side + 1, layer = row * row;
        const int64_t from = i + j * row + k * layer;
        int32_t c[8];
        for (int n = 0; n < 8; ++n) c[n] = (int32_t)(from + (n % 4 == 1 || n % 4 == 2) + (n % 4 > 1 ? row : 0) + (n > 3 ? layer : 0));
        if (kind == HOOKS) mesh_hooks(&m, c);
        else mesh_cut(&m, c, (int)((i + j) % 2));
    }
    return m;
}

static inline peri_cells_desc mesh_desc(const cell_mesh *m) {
    peri_cells_desc d;
    peri_cells_desc_init(&d);
    d.vertex_count = m->vertices;
    d.vertices = m->x;
    d.cell_count = m->cells;
    d.corners = m->corner;
    d.offsets = m->offset;
    return d;
}

static inline peri_body *mesh_body(const cell_mesh *m, const solid *s) {
    const peri_cells_desc d = mesh_desc(m);
    peri_body *b = solid_new(s);
    CHECK(MUST(b, peri_add_cells(b, &d)) == m->cells);
    (void)MUST(b, peri_build(b));
    return b;
}

#endif
