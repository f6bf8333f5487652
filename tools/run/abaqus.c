/* SPDX-License-Identifier: MIT */
/* abaqus.c - Abaqus input files: *NODE, *ELEMENT, *NSET, *ELSET, one part without a placement. A set of nodes is the set of the cells that
   have one of them. Other keywords and their lines are passed over. */
#include "run.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { PASSED_OVER, NODES, ELEMENTS, NODE_SET, ELEMENT_SET, PLACEMENT };

typedef struct abaqus {
    run_mesh *mesh;
    int       state, parts, generate;
    int       dim, corners, nodes; /* of the elements that are read */
    int       have;                /* numbers of the present element */
    int64_t   list;                /* the set, or -1 */
    run_cell *cell;
} abaqus;

/* The value of NAME=value, blanks and quotes aside; NULL: not given. A parameter without '=' has the value "". */
static char *parameter(run_text *t, const char *name) {
    static char nothing[] = "";
    int k;
    for (k = 1; k < t->count && k < RUN_TOKENS; ++k) {
        char  *token = t->token[k] + strspn(t->token[k], " \t"), *equals = strchr(token, '=');
        size_t length = equals == NULL ? strlen(token) : (size_t)(equals - token), i;
        while (length > 0 && (token[length - 1] == ' ' || token[length - 1] == '\t')) --length;
        if (length != strlen(name)) continue;
        for (i = 0; i < length && toupper((unsigned char)token[i]) == name[i]; ++i) {}
        if (i < length) continue;
        if (equals == NULL) return nothing;
        equals += 1 + strspn(equals + 1, " \t\"");
        for (i = strlen(equals); i > 0 && strchr(" \t\"", equals[i - 1]) != NULL; --i) equals[i - 1] = 0;
        return equals;
    }
    return NULL;
}

static int known_type(abaqus *a, const char *type) {
    static const struct { int dim, nodes, corners; } shapes[] = {{2, 3, 3},  {2, 4, 4},  {2, 6, 3},  {2, 8, 4}, {3, 4, 4},
                                                                 {3, 5, 5},  {3, 6, 6},  {3, 8, 8},  {3, 10, 4}, {3, 15, 6}, {3, 20, 8}};
    const int solid = strncmp(type, "C3D", 3) == 0, plane = strncmp(type, "CPS", 3) == 0 || strncmp(type, "CPE", 3) == 0;
    const int nodes = solid || plane ? atoi(type + 3) : 0;
    size_t k;
    for (k = 0; k < sizeof shapes / sizeof *shapes; ++k)
        if (nodes == shapes[k].nodes && (solid ? 3 : 2) == shapes[k].dim) {
            a->dim = shapes[k].dim;
            a->nodes = nodes;
            a->corners = shapes[k].corners;
            return 0;
        }
    return run_mesh_fail(a->mesh, "TYPE", "elements of this type are not read: CPS, CPE and C3D with 3 to 20 nodes are");
}

static int begin_list(abaqus *a, const char *name, int of_cells) {
    run_nodes *list;
    if (*name == 0) return run_mesh_fail(a->mesh, of_cells ? "ELSET" : "NSET", "has no name");
    list = run_mesh_list(a->mesh, name, of_cells);
    if (list == NULL) return -1;
    a->list = list - a->mesh->list;
    return 0;
}

static int begin_elements(abaqus *a) {
    run_text *t = a->mesh->text;
    char     *type = parameter(t, "TYPE"), *set = parameter(t, "ELSET"), *c;
    a->state = ELEMENTS;
    if (type == NULL) return run_mesh_fail(a->mesh, "TYPE", "*ELEMENT has none");
    for (c = type; *c != 0; ++c) *c = (char)toupper((unsigned char)*c);
    if (known_type(a, type) < 0) return -1;
    return set == NULL ? 0 : begin_list(a, set, 1);
}

static int keyword(abaqus *a) {
    run_text *t = a->mesh->text;
    char     *word = t->token[0] + 1, *set;
    size_t    length = strlen(word);
    while (length > 0 && (word[length - 1] == ' ' || word[length - 1] == '\t')) word[--length] = 0;
    if (a->have > 0) return run_mesh_fail(a->mesh, "ELEMENT", "the element before has too few nodes");
    a->state = PASSED_OVER;
    a->list = -1;
    if (parameter(t, "INPUT") != NULL && (run_same(word, "NODE") || run_same(word, "ELEMENT") || run_same(word, "INCLUDE")))
        return run_mesh_fail(a->mesh, "INPUT", "other files are not read");
    if (run_same(word, "NODE")) {
        a->state = NODES;
        set = parameter(t, "NSET");
        return set == NULL ? 0 : begin_list(a, set, 0);
    }
    if (run_same(word, "ELEMENT")) return begin_elements(a);
    if (run_same(word, "NSET") || run_same(word, "ELSET")) {
        const int of_cells = run_same(word, "ELSET");
        a->state = of_cells ? ELEMENT_SET : NODE_SET;
        a->generate = parameter(t, "GENERATE") != NULL;
        set = parameter(t, of_cells ? "ELSET" : "NSET");
        return begin_list(a, set == NULL ? "" : set, of_cells);
    }
    if (run_same(word, "INSTANCE")) a->state = PLACEMENT;
    if (run_same(word, "PART") && a->parts++ > 0) return run_mesh_fail(a->mesh, "PART", "more than one part");
    return 0;
}

static int add_node(abaqus *a) {
    run_text *t = a->mesh->text;
    if (t->count < 3) return run_mesh_fail(a->mesh, "NODE", "is not: number, x, y, z");
    if (run_mesh_node(a->mesh, t->token[0], t->token + 1, t->count > 3 ? 3 : 2) < 0) return -1;
    if (a->list >= 0 && run_mesh_list_add(&a->mesh->list[a->list], a->mesh->node[a->mesh->nodes - 1].id) < 0)
        return run_mesh_fail(a->mesh, "NSET", "no memory");
    return 0;
}

/* An element may go over several lines. */
static int add_element(abaqus *a) {
    run_text *t = a->mesh->text;
    long long id;
    int       k;
    for (k = 0; k < t->count; ++k) {
        if (k >= RUN_TOKENS || run_whole(t->token[k], &id) < 0) return run_mesh_fail(a->mesh, "ELEMENT", "is not a whole number");
        if (a->have == 0) {
            a->cell = run_mesh_cell(a->mesh, id, a->dim, a->corners);
            if (a->cell == NULL) return -1;
            if (a->list >= 0 && run_mesh_list_add(&a->mesh->list[a->list], id) < 0) return run_mesh_fail(a->mesh, "ELSET", "no memory");
        } else if (a->have <= a->corners) a->cell->node[a->have - 1] = id;
        if (++a->have <= a->nodes) continue;
        a->have = 0;
        if (k + 1 < t->count) return run_mesh_fail(a->mesh, "ELEMENT", "more nodes than this type has");
    }
    return 0;
}

static int add_range(abaqus *a, const char *field) {
    run_text *t = a->mesh->text;
    long long range[3] = {0, 0, 1};
    int       k;
    for (k = 0; k < t->count && k < 3; ++k)
        if (run_whole(t->token[k], &range[k]) < 0) return run_mesh_fail(a->mesh, field, "is not a whole number");
    if (t->count < 2 || t->count > 3 || range[2] < 1 || range[0] < 0 || range[1] < range[0] ||
        (range[1] - range[0]) / range[2] > a->mesh->nodes + a->mesh->cells)
        return run_mesh_fail(a->mesh, field, "is not: first, last, step; within the numbers of the file");
    for (; range[0] <= range[1]; range[0] += range[2])
        if (run_mesh_list_add(&a->mesh->list[a->list], range[0]) < 0) return run_mesh_fail(a->mesh, field, "no memory");
    return 0;
}

static int add_members(abaqus *a) {
    run_text   *t = a->mesh->text;
    const char *field = a->state == ELEMENT_SET ? "ELSET" : "NSET";
    long long   id;
    int         k;
    int64_t     other, m;
    if (a->generate) return add_range(a, field);
    for (k = 0; k < t->count; ++k) {
        run_nodes *list = &a->mesh->list[a->list];
        if (k >= RUN_TOKENS) return run_mesh_fail(a->mesh, field, "too many numbers in a line");
        if (run_whole(t->token[k], &id) == 0) {
            if (run_mesh_list_add(list, id) < 0) return run_mesh_fail(a->mesh, field, "no memory");
            continue;
        }
        for (other = 0; other < a->mesh->lists; ++other) { /* a set of sets */
            const run_nodes *set = &a->mesh->list[other];
            if (other != a->list && set->of_cells == list->of_cells && run_same(set->name, t->token[k])) break;
        }
        if (other == a->mesh->lists) return run_mesh_fail(a->mesh, field, "is neither a whole number nor the name of a set before");
        for (m = 0; m < a->mesh->list[other].count; ++m)
            if (run_mesh_list_add(list, a->mesh->list[other].id[m]) < 0) return run_mesh_fail(a->mesh, field, "no memory");
    }
    return 0;
}

int run_read_abaqus(run_mesh *mesh) {
    abaqus    a;
    run_text *t = mesh->text;
    int       result = 0;
    memset(&a, 0, sizeof a);
    a.mesh = mesh;
    a.list = -1;
    while (result == 0) {
        const size_t at = t->at; /* a line of a keyword is split at commas alone: NSET = left */
        const char  *head = t->bytes + at;
        int          more;
        head += strspn(head, " \t\r\n");
        more = run_text_next(t, *head == '*' ? ",\r" : ", \t\r", 0);
        if (more == 0) break;
        while (t->token[0][0] == ' ' || t->token[0][0] == '\t') ++t->token[0];
        if (t->token[0][0] == '*') result = t->token[0][1] == '*' ? 0 : keyword(&a);
        else if (a.state == NODES) result = add_node(&a);
        else if (a.state == ELEMENTS) result = add_element(&a);
        else if (a.state == NODE_SET || a.state == ELEMENT_SET) result = add_members(&a);
        else if (a.state == PLACEMENT) result = run_mesh_fail(mesh, "INSTANCE", "a placement of a part is not read");
    }
    if (result == 0 && a.have > 0) result = run_mesh_fail(mesh, "ELEMENT", "the file ends within an element");
    return result;
}
