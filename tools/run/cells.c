/* SPDX-License-Identifier: MIT */
/* cells.c - nodes and cells of a mesh become points at the centroids of the cells, with their volumes, and sets of points.

   A solid cell is cut into tetrahedra from the mean of its corners to triangles of its faces, from the mean of a face to its sides: exact
   where faces are plane, and for the trilinear hexahedron the volume is, too, whatever its faces. */
#include "run.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

int run_mesh_fail(run_mesh *mesh, const char *field, const char *text) {
    return run_fail(mesh->text->fault, mesh->text->path, mesh->text->line, field, text);
}

int run_mesh_node(run_mesh *mesh, const char *id, char **x, int given) {
    run_node *node;
    int       k;
    if (run_grow((void **)&mesh->node, mesh->nodes, &mesh->node_capacity, sizeof *mesh->node) < 0)
        return run_mesh_fail(mesh, "node", "no memory");
    node = &mesh->node[mesh->nodes];
    memset(node, 0, sizeof *node);
    node->line = mesh->text->line;
    if (run_whole(id, &node->id) < 0) return run_mesh_fail(mesh, "node", "its number is not a whole number");
    for (k = 0; k < given; ++k)
        if (run_number(x[k], &node->x[k]) < 0) return run_mesh_fail(mesh, "node", "a coordinate is not a finite number");
    ++mesh->nodes;
    return 0;
}

run_cell *run_mesh_cell(run_mesh *mesh, long long id, int dim, int corners) {
    run_cell *cell;
    if (run_grow((void **)&mesh->cell, mesh->cells, &mesh->cell_capacity, sizeof *mesh->cell) < 0) {
        (void)run_mesh_fail(mesh, "element", "no memory");
        return NULL;
    }
    cell = &mesh->cell[mesh->cells++];
    memset(cell, 0, sizeof *cell);
    cell->id = id;
    cell->dim = dim;
    cell->corners = corners;
    cell->line = mesh->text->line;
    return cell;
}

run_nodes *run_mesh_list(run_mesh *mesh, const char *name, int of_cells) {
    int64_t    k;
    run_nodes *list;
    for (k = 0; k < mesh->lists; ++k)
        if (mesh->list[k].of_cells == of_cells && run_same(mesh->list[k].name, name)) return &mesh->list[k];
    if (run_grow((void **)&mesh->list, mesh->lists, &mesh->list_capacity, sizeof *mesh->list) < 0) {
        (void)run_mesh_fail(mesh, "set", "no memory");
        return NULL;
    }
    list = &mesh->list[mesh->lists];
    memset(list, 0, sizeof *list);
    if (run_copy(list->name, sizeof list->name, name) < 0) {
        (void)run_mesh_fail(mesh, "set", "a name of more than 79 bytes");
        return NULL;
    }
    list->line = mesh->text->line;
    list->of_cells = of_cells;
    ++mesh->lists;
    return list;
}

int run_mesh_list_add(run_nodes *list, long long id) {
    if (run_grow((void **)&list->id, list->count, &list->capacity, sizeof *list->id) < 0) return -1;
    list->id[list->count++] = id;
    return 0;
}

void run_mesh_free(run_mesh *mesh) {
    int64_t k;
    for (k = 0; k < mesh->lists; ++k) free(mesh->list[k].id);
    free(mesh->list);
    free(mesh->node);
    free(mesh->cell);
    memset(mesh, 0, sizeof *mesh);
}

/* ---- geometry of a cell */

static double triangle_fan(const double (*x)[3], const int *face, int sides, const double *from, double *moment) {
    double middle[3] = {0, 0, 0}, sum = 0;
    int    k, d;
    for (k = 0; k < sides; ++k)
        for (d = 0; d < 3; ++d) middle[d] += x[face[k]][d] / sides;
    for (k = 0; k < sides; ++k) {
        const double *p = x[face[k]], *q = x[face[(k + 1) % sides]];
        double a[3], b[3], c[3], volume;
        for (d = 0; d < 3; ++d) a[d] = p[d] - from[d], b[d] = q[d] - from[d], c[d] = middle[d] - from[d];
        volume = (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
        sum += volume;
        for (d = 0; d < 3; ++d) moment[d] += volume * (a[d] + b[d] + c[d]) / 4;
    }
    return sum;
}

static double solid(const double (*x)[3], int corners, const double *from, double *moment) {
    static const int tetrahedron[4][4] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}};
    static const int pyramid[5][4] = {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
    static const int wedge[5][4] = {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    static const int brick[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    const int (*face)[4] = corners == 4 ? tetrahedron : corners == 5 ? pyramid : corners == 6 ? wedge : brick;
    const int faces = corners == 4 ? 4 : corners == 8 ? 6 : 5;
    double    volume = 0;
    int       k;
    for (k = 0; k < faces; ++k) volume += triangle_fan(x, face[k], face[k][3] < 0 ? 3 : 4, from, moment);
    return volume;
}

static double plane(const double (*x)[3], int corners, const double *from, double *moment) {
    double area = 0;
    int    k, d;
    for (k = 0; k < corners; ++k) {
        const double *p = x[k], *q = x[(k + 1) % corners];
        const double  twice = (p[0] - from[0]) * (q[1] - from[1]) - (p[1] - from[1]) * (q[0] - from[0]);
        area += twice / 2;
        for (d = 0; d < 2; ++d) moment[d] += twice / 6 * (p[d] + q[d] - 2 * from[d]);
    }
    return area;
}

/* -1: the cell has no volume. `from` is near its middle: far from the origin the products would lose digits. */
static int measure(const double (*x)[3], const run_cell *cell, double *place, double *volume) {
    double from[3] = {0, 0, 0}, moment[3] = {0, 0, 0}, size = 0;
    int    k, d;
    for (k = 0; k < cell->corners; ++k)
        for (d = 0; d < 3; ++d) from[d] += x[k][d] / cell->corners;
    for (k = 0; k < cell->corners; ++k)
        for (d = 0; d < cell->dim; ++d) size = fmax(size, fabs(x[k][d] - from[d]));
    *volume = cell->dim == 3 ? solid(x, cell->corners, from, moment) : plane(x, cell->corners, from, moment);
    for (d = 0; d < 3; ++d) place[d] = from[d] + moment[d] / *volume;
    *volume = fabs(*volume);
    if (cell->dim == 2) place[2] = 0;
    return *volume > 1e-12 * pow(size, cell->dim) && isfinite(*volume) && isfinite(place[0] + place[1] + place[2]) ? 0 : -1;
}

/* ---- the whole mesh */

static int by_id(const void *a, const void *b) {
    const long long p = ((const run_node *)a)->id, q = ((const run_node *)b)->id;
    return (p > q) - (p < q);
}

typedef struct pair {
    long long key;
    int64_t   value;
} pair;

static int by_key(const void *a, const void *b) {
    const pair *p = (const pair *)a, *q = (const pair *)b;
    return p->key != q->key ? (p->key > q->key) - (p->key < q->key) : (p->value > q->value) - (p->value < q->value);
}

/* The first pair of a key, or the end. */
static int64_t find_pair(const pair *pairs, int64_t count, long long key) {
    int64_t lo = 0, hi = count;
    while (lo < hi) {
        const int64_t middle = lo + (hi - lo) / 2;
        if (pairs[middle].key < key) lo = middle + 1;
        else hi = middle;
    }
    return lo;
}

static const run_node *find_node(const run_mesh *mesh, long long id) {
    run_node key;
    key.id = id;
    return mesh->nodes == 0 ? NULL : (const run_node *)bsearch(&key, mesh->node, (size_t)mesh->nodes, sizeof key, by_id);
}

static int at_line(run_mesh *mesh, long line, const char *field, const char *text) {
    mesh->text->line = line;
    return run_mesh_fail(mesh, field, text);
}

static int check_nodes(run_mesh *mesh) {
    int64_t k;
    if (mesh->nodes == 0) return run_mesh_fail(mesh, "nodes", "the file holds none");
    qsort(mesh->node, (size_t)mesh->nodes, sizeof *mesh->node, by_id);
    for (k = 1; k < mesh->nodes; ++k)
        if (mesh->node[k].id == mesh->node[k - 1].id) {
            const long p = mesh->node[k].line, q = mesh->node[k - 1].line;
            return at_line(mesh, p > q ? p : q, "node", "its number is given twice");
        }
    return 0;
}

static int add_cells(run_mesh *mesh, run_cloud *cloud) {
    int64_t k;
    for (k = 0; k < mesh->cells; ++k) {
        const run_cell *cell = &mesh->cell[k];
        double x[8][3], place[3], volume;
        int    c;
        for (c = 0; c < cell->corners; ++c) {
            const run_node *node = find_node(mesh, cell->node[c]);
            if (node == NULL) return at_line(mesh, cell->line, "element", "a node of it is not in the file");
            memcpy(x[c], node->x, sizeof x[c]);
        }
        if (cell->dim != mesh->dim) continue;
        if (measure((const double(*)[3])x, cell, place, &volume) < 0) return at_line(mesh, cell->line, "element", "has no volume");
        if (run_add_cell(cloud, cell->corners, (const double(*)[3])x, place, volume) < 0)
            return at_line(mesh, cell->line, "element", "no memory");
    }
    return cloud->count > 0 ? 0 : run_mesh_fail(mesh, "elements", mesh->dim == 2 ? "no triangle or quadrilateral in the file"
                                                                                  : "no solid element in the file");
}

static int holds(const run_cell *cell, const run_cell *side) {
    int k, c, found = 0;
    for (k = 0; k < side->corners; ++k)
        for (c = 0; c < cell->corners; ++c)
            if (cell->node[c] == side->node[k]) { ++found; break; }
    return found == side->corners;
}

/* `of_node`: the cells of the body's dimension at each node; `point`: the point of each of these cells. */
static int add_groups(run_mesh *mesh, run_cloud *cloud, const pair *of_node, int64_t pairs, const int64_t *point) {
    int64_t k, p;
    for (k = 0; k < mesh->cells; ++k) {
        const run_cell *cell = &mesh->cell[k];
        run_set *set = cell->group > 0 ? run_make_set(cloud, mesh->list[cell->group - 1].name) : NULL;
        if (cell->group == 0 || cell->dim > mesh->dim) continue;
        if (set == NULL) return at_line(mesh, cell->line, "set", "no memory");
        if (cell->dim == mesh->dim) {
            if (run_add_member(set, point[k]) < 0) return at_line(mesh, cell->line, "set", "no memory");
            continue;
        }
        for (p = find_pair(of_node, pairs, cell->node[0]); p < pairs && of_node[p].key == cell->node[0]; ++p)
            if (holds(&mesh->cell[of_node[p].value], cell) && run_add_member(set, point[of_node[p].value]) < 0)
                return at_line(mesh, cell->line, "set", "no memory");
    }
    return 0;
}

static int add_list(run_mesh *mesh, run_cloud *cloud, const run_nodes *list, const pair *from, int64_t pairs, const int64_t *point) {
    run_set *set = run_make_set(cloud, list->name);
    int64_t  k, p;
    if (set == NULL) return at_line(mesh, list->line, "set", "no memory");
    for (k = 0; k < list->count; ++k) {
        const int64_t first = find_pair(from, pairs, list->id[k]);
        const int there = list->of_cells ? first < pairs && from[first].key == list->id[k] : find_node(mesh, list->id[k]) != NULL;
        if (!there) return at_line(mesh, list->line, list->name, list->of_cells ? "an element of this set is not in the file"
                                                                                : "a node of this set is not in the file");
        for (p = first; p < pairs && from[p].key == list->id[k]; ++p)
            if (point[from[p].value] >= 0 && run_add_member(set, point[from[p].value]) < 0)
                return at_line(mesh, list->line, "set", "no memory");
    }
    return 0;
}

static int add_sets(run_mesh *mesh, run_cloud *cloud, pair *of_node, pair *of_cell, int64_t *point) {
    int64_t k, pairs = 0, points = 0;
    int     c;
    for (k = 0; k < mesh->cells; ++k) {
        const int own = mesh->cell[k].dim == mesh->dim;
        point[k] = own ? points++ : -1;
        of_cell[k].key = mesh->cell[k].id;
        of_cell[k].value = k;
        for (c = 0; own && c < mesh->cell[k].corners; ++c) {
            of_node[pairs].key = mesh->cell[k].node[c];
            of_node[pairs++].value = k;
        }
    }
    qsort(of_node, (size_t)pairs, sizeof *of_node, by_key);
    qsort(of_cell, (size_t)mesh->cells, sizeof *of_cell, by_key);
    for (k = 1; k < mesh->cells; ++k)
        if (of_cell[k].key == of_cell[k - 1].key)
            return at_line(mesh, mesh->cell[of_cell[k].value].line, "element", "its number is given twice");
    if (add_groups(mesh, cloud, of_node, pairs, point) < 0) return -1;
    for (k = 0; k < mesh->lists; ++k)
        if (mesh->list[k].of_cells >= 0 && add_list(mesh, cloud, &mesh->list[k], mesh->list[k].of_cells ? of_cell : of_node,
                                                    mesh->list[k].of_cells ? mesh->cells : pairs, point) < 0)
            return -1;
    return 0;
}

int run_mesh_points(run_mesh *mesh, run_cloud *cloud) {
    pair    *of_node, *of_cell;
    int64_t *point;
    int      result;
    if (check_nodes(mesh) < 0 || add_cells(mesh, cloud) < 0) return -1;
    of_node = (pair *)malloc((size_t)mesh->cells * 8 * sizeof *of_node);
    of_cell = (pair *)malloc((size_t)mesh->cells * sizeof *of_cell);
    point = (int64_t *)malloc((size_t)mesh->cells * sizeof *point);
    if (of_node == NULL || of_cell == NULL || point == NULL) result = run_mesh_fail(mesh, "sets", "no memory");
    else result = add_sets(mesh, cloud, of_node, of_cell, point);
    free(of_node);
    free(of_cell);
    free(point);
    return result;
}
