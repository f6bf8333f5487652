/* SPDX-License-Identifier: MIT */
/* gmsh.c - Gmsh meshes in ASCII, formats 2.x and 4.1: nodes, elements (of higher order by their corners) and physical groups. A group of
   the body's dimension is the set of its cells; one of lines or faces the set of the cells that have them as sides. */
#include "run.h"
#include <stdlib.h>
#include <string.h>

static const char blank[] = " \t\r";

typedef struct kind {
    int type, dim, corners, nodes;
} kind;

static const kind *find_kind(long long type) {
    static const kind kinds[] = {{15, 0, 1, 1}, {1, 1, 2, 2},  {8, 1, 2, 3},   {2, 2, 3, 3},   {9, 2, 3, 6},   {3, 2, 4, 4},
                                 {16, 2, 4, 8}, {10, 2, 4, 9}, {4, 3, 4, 4},  {11, 3, 4, 10}, {5, 3, 8, 8},
                                 {17, 3, 8, 20}, {12, 3, 8, 27}, {6, 3, 6, 6},
                                 {18, 3, 6, 15}, {13, 3, 6, 18}, {7, 3, 5, 5}, {19, 3, 5, 13}, {14, 3, 5, 14}};
    size_t k;
    for (k = 0; k < sizeof kinds / sizeof *kinds; ++k)
        if (kinds[k].type == type) return &kinds[k];
    return NULL;
}

/* Which physical group an entity is in (format 4), or its name by its number: key is dim and tag. */
typedef struct group {
    int       dim;
    long long tag, physical;
} group;

typedef struct gmsh {
    run_mesh *mesh;
    int64_t   groups, capacity;
    group    *entity;
    int       version;
} gmsh;

static int next(gmsh *g, const char *field) {
    if (run_text_next(g->mesh->text, blank, 0) > 0) return 0;
    return run_mesh_fail(g->mesh, field, "the file ends within this section");
}

/* The whole numbers at the head of the line. */
static int wholes(gmsh *g, const char *field, int count, long long *to) {
    run_text *t = g->mesh->text;
    int       k;
    if (t->count < count || count > RUN_TOKENS) return run_mesh_fail(g->mesh, field, "too few numbers in this line");
    for (k = 0; k < count; ++k)
        if (run_whole(t->token[k], &to[k]) < 0) return run_mesh_fail(g->mesh, field, "is not a whole number");
    return 0;
}

/* A line that begins a section with the count of what follows. */
static int counted(gmsh *g, const char *field, int count, long long *to) {
    int k;
    if (next(g, field) < 0 || wholes(g, field, count, to) < 0) return -1;
    for (k = 0; k < count; ++k)
        if (to[k] < 0) return run_mesh_fail(g->mesh, field, "a count is negative");
    return 0;
}

static int ends(gmsh *g, const char *name) {
    if (next(g, name + 1) < 0) return -1;
    return strcmp(g->mesh->text->token[0], name) == 0 ? 0 : run_mesh_fail(g->mesh, name + 4, "more or fewer lines than its count says");
}

/* The name of a group, "group_TAG" where the file gives none; its index + 1, or -1. Lists of kind -1 - dim are names alone. */
static int group_of(gmsh *g, int dim, long long physical) {
    run_mesh *mesh = g->mesh;
    char       name[RUN_NAME];
    run_nodes *list;
    int64_t    k;
    if (physical == 0) return 0;
    for (k = 0; k < mesh->lists; ++k)
        if (mesh->list[k].of_cells == -1 - dim && mesh->list[k].id[0] == physical) return (int)k + 1;
    (void)snprintf(name, sizeof name, "group_%lld", physical);
    list = run_mesh_list(mesh, name, -1 - dim);
    if (list == NULL) return -1;
    if (list->count == 0 && run_mesh_list_add(list, physical) < 0) return run_mesh_fail(mesh, "group", "no memory");
    return (int)(list - mesh->list) + 1;
}

static int read_format(gmsh *g) {
    double    version;
    run_text *t = g->mesh->text;
    if (next(g, "MeshFormat") < 0) return -1;
    if (t->count < 2 || run_number(t->token[0], &version) < 0) return run_mesh_fail(g->mesh, "MeshFormat", "is not a version");
    g->version = version >= 2.0 && version < 3.0 ? 2 : version > 4.05 && version < 5.0 ? 4 : 0;
    if (g->version == 0) return run_mesh_fail(g->mesh, "MeshFormat", "only versions 2.x and 4.1 are read");
    if (strcmp(t->token[1], "0") != 0) return run_mesh_fail(g->mesh, "MeshFormat", "the file is binary: save it as ASCII");
    return ends(g, "$EndMeshFormat");
}

static int read_names(gmsh *g) {
    run_text  *t = g->mesh->text;
    long long  count, head[2];
    char       name[2 * RUN_NAME];
    run_nodes *list;
    if (counted(g, "PhysicalNames", 1, &count) < 0) return -1;
    for (; count > 0; --count) {
        int k;
        size_t length = 0;
        if (next(g, "PhysicalNames") < 0 || wholes(g, "PhysicalNames", 2, head) < 0) return -1;
        if (t->count < 3 || t->count > RUN_TOKENS || head[0] < 0 || head[0] > 3 || head[1] == 0)
            return run_mesh_fail(g->mesh, "PhysicalNames", "is not: dimension number \"name\"");
        for (k = 2; k < t->count && length < RUN_NAME; ++k) /* blanks of a name become underscores: a deck names sets by one word */
            length += (size_t)snprintf(name + length, sizeof name - length, "%s%.80s", k > 2 ? "_" : "", t->token[k]);
        if (length < 3 || name[0] != '"' || name[length - 1] != '"')
            return run_mesh_fail(g->mesh, "PhysicalNames", "the name is not in quotes, or empty, or of more than 77 bytes");
        name[length - 1] = 0;
        list = run_mesh_list(g->mesh, name + 1, -1 - (int)head[0]);
        if (list == NULL) return -1;
        if (list->count > 0) return run_mesh_fail(g->mesh, "PhysicalNames", "a name is given twice");
        if (run_mesh_list_add(list, head[1]) < 0) return run_mesh_fail(g->mesh, "PhysicalNames", "no memory");
    }
    return ends(g, "$EndPhysicalNames");
}

static int read_entities(gmsh *g) {
    run_text *t = g->mesh->text;
    long long counts[4], tag, physicals, physical;
    int       dim;
    if (counted(g, "Entities", 4, counts) < 0) return -1;
    for (dim = 0; dim < 4; ++dim)
        for (; counts[dim] > 0; --counts[dim]) {
            const int at = dim == 0 ? 4 : 7; /* after the place or the box */
            if (next(g, "Entities") < 0) return -1;
            if (t->count <= at || run_whole(t->token[0], &tag) < 0 || run_whole(t->token[at], &physicals) < 0 || physicals < 0 ||
                physicals > RUN_TOKENS)
                return run_mesh_fail(g->mesh, "Entities", "is not a line of an entity");
            if (physicals == 0) continue;
            if (t->count <= at + 1 || run_whole(t->token[at + 1], &physical) < 0)
                return run_mesh_fail(g->mesh, "Entities", "is not a line of an entity");
            if (physicals > 1) return run_mesh_fail(g->mesh, "Entities", "an entity is in more than one physical group");
            if (run_grow((void **)&g->entity, g->groups, &g->capacity, sizeof *g->entity) < 0)
                return run_mesh_fail(g->mesh, "Entities", "no memory");
            g->entity[g->groups].dim = dim;
            g->entity[g->groups].tag = tag;
            g->entity[g->groups++].physical = physical < 0 ? -(physical + 1) + 1 : physical; /* the sign is an orientation */
        }
    return ends(g, "$EndEntities");
}

static int read_nodes_2(gmsh *g) {
    long long count;
    if (counted(g, "Nodes", 1, &count) < 0) return -1;
    for (; count > 0; --count) {
        if (next(g, "Nodes") < 0) return -1;
        if (g->mesh->text->count != 4) return run_mesh_fail(g->mesh, "Nodes", "is not: number x y z");
        if (run_mesh_node(g->mesh, g->mesh->text->token[0], g->mesh->text->token + 1, 3) < 0) return -1;
    }
    return ends(g, "$EndNodes");
}

static int read_nodes_4(gmsh *g) {
    run_text *t = g->mesh->text;
    long long head[4], block[4], k;
    char      zero[2] = "0", *x[3];
    if (counted(g, "Nodes", 4, head) < 0) return -1;
    for (x[0] = x[1] = x[2] = zero; head[0] > 0; --head[0]) {
        const int64_t first = g->mesh->nodes;
        if (next(g, "Nodes") < 0 || wholes(g, "Nodes", 4, block) < 0) return -1;
        if (block[3] < 0) return run_mesh_fail(g->mesh, "Nodes", "a count is negative");
        for (k = 0; k < block[3]; ++k) {
            if (next(g, "Nodes") < 0) return -1;
            if (t->count != 1) return run_mesh_fail(g->mesh, "Nodes", "is not the number of a node");
            if (run_mesh_node(g->mesh, t->token[0], x, 3) < 0) return -1;
        }
        for (k = 0; k < block[3]; ++k) {
            double *to = g->mesh->node[first + k].x;
            int     d;
            if (next(g, "Nodes") < 0) return -1;
            if (t->count < 3) return run_mesh_fail(g->mesh, "Nodes", "is not: x y z");
            for (d = 0; d < 3; ++d)
                if (run_number(t->token[d], &to[d]) < 0) return run_mesh_fail(g->mesh, "Nodes", "a coordinate is not a finite number");
        }
    }
    return ends(g, "$EndNodes");
}

/* The element in the present line, its nodes from token `at` on. */
static int add_element(gmsh *g, long long type, long long physical, int at) {
    const kind *k = find_kind(type);
    run_text   *t = g->mesh->text;
    run_cell   *cell;
    long long   id;
    int         c, in;
    if (k == NULL) return run_mesh_fail(g->mesh, "Elements", "an element of this type is not read");
    if (t->count != at + k->nodes) return run_mesh_fail(g->mesh, "Elements", "more or fewer nodes than this type has");
    in = group_of(g, k->dim, physical);
    if (in < 0 || run_whole(t->token[0], &id) < 0) return in < 0 ? -1 : run_mesh_fail(g->mesh, "Elements", "is not a whole number");
    cell = run_mesh_cell(g->mesh, id, k->dim, k->corners);
    if (cell == NULL) return -1;
    cell->group = in;
    for (c = 0; c < k->corners; ++c)
        if (run_whole(t->token[at + c], &cell->node[c]) < 0) return run_mesh_fail(g->mesh, "Elements", "is not a whole number");
    return 0;
}

static int read_elements_2(gmsh *g) {
    long long count, head[4];
    if (counted(g, "Elements", 1, &count) < 0) return -1;
    for (; count > 0; --count) {
        if (next(g, "Elements") < 0 || wholes(g, "Elements", 3, head) < 0) return -1;
        if (head[2] < 0 || head[2] > 30) return run_mesh_fail(g->mesh, "Elements", "the number of tags is not 0..30");
        if (head[2] > 0 && wholes(g, "Elements", 4, head) < 0) return -1;
        if (add_element(g, head[1], head[2] > 0 ? head[3] : 0, 3 + (int)head[2]) < 0) return -1;
    }
    return ends(g, "$EndElements");
}

static int read_elements_4(gmsh *g) {
    long long head[4], block[4], physical;
    int64_t   k;
    if (counted(g, "Elements", 4, head) < 0) return -1;
    for (; head[0] > 0; --head[0]) {
        if (next(g, "Elements") < 0 || wholes(g, "Elements", 4, block) < 0) return -1;
        if (block[3] < 0) return run_mesh_fail(g->mesh, "Elements", "a count is negative");
        for (physical = 0, k = 0; k < g->groups; ++k)
            if (g->entity[k].dim == block[0] && g->entity[k].tag == block[1]) physical = g->entity[k].physical;
        for (; block[3] > 0; --block[3])
            if (next(g, "Elements") < 0 || add_element(g, block[2], physical, 1) < 0) return -1;
    }
    return ends(g, "$EndElements");
}

/* Sections of no use here, up to their end. */
static int skip(gmsh *g) {
    run_text *t = g->mesh->text;
    char      end[RUN_NAME];
    if (t->token[0][0] != '$' || strlen(t->token[0]) + 5 > sizeof end)
        return run_mesh_fail(g->mesh, "section", "a line outside of sections");
    (void)snprintf(end, sizeof end, "$End%.60s", t->token[0] + 1);
    do {
        if (next(g, "section") < 0) return -1;
    } while (strcmp(t->token[0], end) != 0);
    return 0;
}

static int read_section(gmsh *g) {
    const char *name = g->mesh->text->token[0];
    if (strcmp(name, "$MeshFormat") == 0) return read_format(g);
    if (g->version == 0) return run_mesh_fail(g->mesh, "MeshFormat", "a Gmsh file begins with $MeshFormat");
    if (strcmp(name, "$PhysicalNames") == 0) return read_names(g);
    if (strcmp(name, "$Entities") == 0 && g->version == 4) return read_entities(g);
    if (strcmp(name, "$Nodes") == 0) return g->version == 2 ? read_nodes_2(g) : read_nodes_4(g);
    if (strcmp(name, "$Elements") == 0) return g->version == 2 ? read_elements_2(g) : read_elements_4(g);
    return skip(g);
}

int run_read_gmsh(run_mesh *mesh) {
    gmsh g;
    int  result = 0;
    memset(&g, 0, sizeof g);
    g.mesh = mesh;
    while (result == 0 && run_text_next(mesh->text, blank, 0) > 0) result = read_section(&g);
    free(g.entity);
    return result;
}
