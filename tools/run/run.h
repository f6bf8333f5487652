/* SPDX-License-Identifier: MIT */
/* run.h - the parts of peri_run, a program that reads a scene from a text file: text.c splits lines, deck.c reads decks, cells.c and mesh.c
   read clouds and meshes, scene.c makes the body, loads.c what acts on it, result.c runs it and writes. Nothing here ends the program or
   keeps global state: what fails fills a run_fault and returns -1, and the caller frees. */
#ifndef PERI_RUN_H
#define PERI_RUN_H

#if defined(_MSC_VER) && !defined(_CRT_SECURE_NO_WARNINGS)
#define _CRT_SECURE_NO_WARNINGS /* MSVC: fopen is the C99 way to open a file */
#endif

#include "../../peri.h"
#include <stdio.h>

enum {
    RUN_TOKENS = 64, /* of a line that are kept */
    RUN_NAME = 80,   /* bytes of a name, the zero included */
    RUN_PATH = 1000  /* likewise of a path */
};

typedef struct run_fault {
    char text[600]; /* "file:line: field: what is wrong" */
} run_fault;

/* Returns -1. line 0: of no line. */
int run_fail(run_fault *fault, const char *path, long line, const char *field, const char *text);

/* ---- text.c: lines and their tokens */

typedef struct run_text {
    const char *path;
    char       *bytes; /* [size + 1], of its own */
    size_t      size, at;
    long        line;                   /* of the present one, from 1 */
    int         count;                  /* its tokens, all of them; */
    char       *token[RUN_TOKENS];      /* the first of them */
    int         raw;                    /* 1: a token may be empty, as between two commas */
    run_fault  *fault;
} run_text;

int  run_text_of(run_text *text, const char *bytes, size_t size, const char *path, run_fault *fault); /* copies */
int  run_text_open(run_text *text, const char *path, run_fault *fault);
void run_text_close(run_text *text);

/* The next line that has a token, split at any of `separators`; '#' ends a line where hash is 1. 0: none is left. */
int run_text_next(run_text *text, const char *separators, int hash);

int run_number(const char *token, double *value);             /* 0, or -1: not a finite number */
int run_whole(const char *token, long long *value);           /* likewise, of whole numbers */
int run_same(const char *a, const char *b);                   /* 1: the same but for capitals */
int run_copy(char *out, size_t capacity, const char *text);   /* -1: too long */

/* Makes room for one more entry of `size` bytes behind count. -1: no memory. */
int run_grow(void **array, int64_t count, int64_t *capacity, size_t size);

/* ---- mesh.c: points with volumes, and sets of them */

typedef struct run_set {
    char     name[RUN_NAME];
    int64_t  count, capacity;
    int32_t *points;
} run_set;

typedef struct run_cloud {
    int64_t  count, capacity;
    double  *place;  /* [count*3] */
    double  *volume; /* [count]; of planes areas. NaN: the file gives none */
    int64_t  corners, corner_capacity, cell_capacity;
    double  *corner;   /* [corners*3] of the cells of a mesh; NULL: of points */
    int64_t *last;     /* [count] corners up to the end of a cell */
    int64_t  sets, set_capacity;
    run_set *set;
} run_cloud;

typedef enum run_format { RUN_FORMAT_GMSH = 1, RUN_FORMAT_ABAQUS, RUN_FORMAT_PERIDIGM, RUN_FORMAT_LAMMPS } run_format;

int  run_read_cloud(run_text *text, int format, int dim, run_cloud *cloud);
void run_free_cloud(run_cloud *cloud);
run_set *run_find_set(run_cloud *cloud, const char *name);
run_set *run_make_set(run_cloud *cloud, const char *name); /* found or new; NULL: no memory, or a name that is too long */
int  run_add_point(run_cloud *cloud, const double *place, double volume);
int  run_add_cell(run_cloud *cloud, int corners, const double (*x)[3], const double *place, double volume); /* and its point */
int  run_add_member(run_set *set, int64_t point);
int  run_sort_sets(run_cloud *cloud); /* ascending, each point once */

/* cells.c: nodes and cells of a mesh, which become points */

typedef struct run_node {
    long long id;
    double    x[3];
    long      line;
} run_node;

typedef struct run_cell {
    long long id;
    long      line;
    int       corners, dim;     /* dim of the cell */
    int       group;            /* its set + 1, or 0 */
    long long node[8];          /* ids */
} run_cell;

typedef struct run_nodes { /* a named list of ids, of nodes or of cells */
    char       name[RUN_NAME];
    long       line;
    int        of_cells;
    int64_t    count, capacity;
    long long *id;
} run_nodes;

typedef struct run_mesh {
    run_text  *text;
    int        dim; /* of the body */
    int64_t    nodes, node_capacity, cells, cell_capacity, lists, list_capacity;
    run_node  *node;
    run_cell  *cell;
    run_nodes *list;
} run_mesh;

int  run_mesh_fail(run_mesh *mesh, const char *field, const char *text);
int  run_mesh_node(run_mesh *mesh, const char *id, char **x, int given); /* given coordinates, 2 or 3 */
run_cell *run_mesh_cell(run_mesh *mesh, long long id, int dim, int corners);
run_nodes *run_mesh_list(run_mesh *mesh, const char *name, int of_cells); /* found or new */
int  run_mesh_list_add(run_nodes *list, long long id);
int  run_mesh_points(run_mesh *mesh, run_cloud *cloud);
void run_mesh_free(run_mesh *mesh);
int  run_read_gmsh(run_mesh *mesh);   /* gmsh.c */
int  run_read_abaqus(run_mesh *mesh); /* abaqus.c */

/* ---- deck.c: sections of lines "key value ..." */

typedef struct run_entry {
    char *key;
    char *value[RUN_TOKENS];
    int   count, used;
    long  line;
} run_entry;

typedef struct run_section {
    char      *kind, *name; /* name "": none */
    long       line;
    int64_t    entries, capacity;
    run_entry *entry;
} run_section;

typedef struct run_deck {
    run_text     text;
    int64_t      sections, capacity;
    run_section *section;
} run_deck;

typedef struct run_choice {
    const char *name;
    int32_t     value;
} run_choice;

enum { RUN_NUMBER, RUN_I32, RUN_I64, RUN_VECTOR, RUN_CHOICE };
typedef struct run_key { /* an entry and where it goes */
    const char       *key;
    int               kind;
    size_t            offset;
    const run_choice *choices; /* up to one without a name */
} run_key;

int run_deck_read(run_deck *deck, const char *path, run_fault *fault);
int run_deck_of(run_deck *deck, const char *bytes, size_t size, const char *path, run_fault *fault);
void run_deck_free(run_deck *deck);
/* NULL: not there. Marks it as used. */
run_entry *run_find(run_section *section, const char *key);
int run_fail_at(run_deck *deck, const run_section *section, const run_entry *entry, const char *key, const char *text);
int run_take(run_deck *deck, run_section *section, const run_key *keys, int dim, void *to);
/* The numbers of an entry: -1 where it is missing, or not `count` of them. */
int run_vector(run_deck *deck, run_section *section, const char *key, int count, double *to);
int run_string(run_deck *deck, run_section *section, const char *key, const char **to); /* likewise one word */
int run_all_used(run_deck *deck, run_section *section);

/* ---- scene.c, loads.c, result.c */

typedef struct run_load {
    const char *name;
    int32_t     id, set, dim; /* dim: numbers of its value */
    double      rise; /* [T] over which the value rises; 0: at once */
} run_load;

enum { RUN_LOADS = 100, RUN_MATERIALS = 120 };
typedef struct run_scene {
    run_deck    deck;
    run_fault  *fault;
    peri_body  *body;
    int         dim, quiet;
    const char *directory; /* of what is written */
    int         materials, loads;
    const char *material_name[RUN_MATERIALS];
    int32_t     material[RUN_MATERIALS];
    run_load    load[RUN_LOADS];
    run_section *output; /* or NULL */
    run_section *now;    /* what runs */
    FILE       *curve;
    const run_load *curve_load;
    int         shown, by_steps;
    double      begun, length; /* of the present run, for the progress line */
    double     *field;         /* [points*dim] scratch of the curve */
} run_scene;

/* Reads and runs a deck. The scene is to be freed also after a failure. */
int run_scene_read(run_scene *scene, const char *path, const char *directory, int quiet, run_fault *fault);
int run_scene_of(run_scene *scene, const char *bytes, size_t size, const char *path, const char *directory, int quiet, run_fault *fault);
int run_scene_make(run_scene *scene);
int run_scene_run(run_scene *scene);
void run_scene_free(run_scene *scene);

/* result as it is, or -1 after a failure of the library, told with the line of the field that it names. */
int64_t run_must(run_scene *scene, run_section *section, int64_t result);
int run_act(run_scene *scene, run_section *section); /* cuts, sets, supports, loads, obstacles; 0: none of these */
int run_set_of(run_scene *scene, run_section *section, int32_t *set);

#endif
