/* SPDX-License-Identifier: MIT */
/* mesh.c - clouds: points, volumes and sets from files. Peridigm text ("x y z block volume") and LAMMPS data are read here. */
#include "run.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char blank[] = " \t\r";

int run_add_point(run_cloud *cloud, const double *place, double volume) {
    int64_t room = cloud->capacity, also = cloud->capacity;
    if (cloud->count >= INT32_MAX || run_grow((void **)&cloud->place, cloud->count, &room, 3 * sizeof *place) < 0) return -1;
    if (run_grow((void **)&cloud->volume, cloud->count, &also, sizeof volume) < 0) return -1;
    cloud->capacity = also;
    memcpy(cloud->place + 3 * cloud->count, place, 3 * sizeof *place);
    cloud->volume[cloud->count++] = volume;
    return 0;
}

int run_add_cell(run_cloud *cloud, int corners, const double (*x)[3], const double *place, double volume) {
    int k;
    if (run_grow((void **)&cloud->last, cloud->count, &cloud->cell_capacity, sizeof *cloud->last) < 0) return -1;
    for (k = 0; k < corners; ++k) {
        if (run_grow((void **)&cloud->corner, cloud->corners, &cloud->corner_capacity, sizeof *x) < 0) return -1;
        memcpy(cloud->corner + 3 * cloud->corners++, x[k], sizeof *x);
    }
    cloud->last[cloud->count] = cloud->corners;
    return run_add_point(cloud, place, volume);
}

run_set *run_find_set(run_cloud *cloud, const char *name) {
    int64_t k;
    for (k = 0; k < cloud->sets; ++k)
        if (run_same(cloud->set[k].name, name)) return &cloud->set[k];
    return NULL;
}

run_set *run_make_set(run_cloud *cloud, const char *name) {
    run_set *set = run_find_set(cloud, name);
    if (set != NULL || run_grow((void **)&cloud->set, cloud->sets, &cloud->set_capacity, sizeof *set) < 0) return set;
    set = &cloud->set[cloud->sets];
    memset(set, 0, sizeof *set);
    if (run_copy(set->name, sizeof set->name, name) < 0) return NULL;
    ++cloud->sets;
    return set;
}

int run_add_member(run_set *set, int64_t point) {
    if (run_grow((void **)&set->points, set->count, &set->capacity, sizeof *set->points) < 0) return -1;
    set->points[set->count++] = (int32_t)point;
    return 0;
}

static int ascending(const void *a, const void *b) {
    const int32_t p = *(const int32_t *)a, q = *(const int32_t *)b;
    return (p > q) - (p < q);
}

int run_sort_sets(run_cloud *cloud) {
    int64_t k, i, kept;
    for (k = 0; k < cloud->sets; ++k) {
        run_set *set = &cloud->set[k];
        if (set->count == 0) continue;
        qsort(set->points, (size_t)set->count, sizeof *set->points, ascending);
        for (kept = 1, i = 1; i < set->count; ++i)
            if (set->points[i] != set->points[kept - 1]) set->points[kept++] = set->points[i];
        set->count = kept;
    }
    return 0;
}

void run_free_cloud(run_cloud *cloud) {
    int64_t k;
    for (k = 0; k < cloud->sets; ++k) free(cloud->set[k].points);
    free(cloud->set);
    free(cloud->place);
    free(cloud->volume);
    free(cloud->corner);
    free(cloud->last);
    memset(cloud, 0, sizeof *cloud);
}

static int fail(run_text *text, const char *field, const char *what) {
    return run_fail(text->fault, text->path, text->line, field, what);
}

/* A point at the numbers of three tokens, in the set "PREFIX_number". */
static int add(run_text *text, run_cloud *cloud, int dim, char **x, const char *volume, const char *prefix, const char *number) {
    double    place[3], size = NAN;
    long long whole;
    char      name[RUN_NAME];
    run_set  *set;
    int       d;
    for (d = 0; d < 3; ++d)
        if (run_number(x[d], &place[d]) < 0) return fail(text, d == 0 ? "x" : d == 1 ? "y" : "z", "is not a finite number");
    if (dim == 2) place[2] = 0;
    if (volume != NULL && (run_number(volume, &size) < 0 || size <= 0)) return fail(text, "volume", "is not a number above 0");
    if (run_whole(number, &whole) < 0) return fail(text, prefix, "is not a whole number");
    (void)snprintf(name, sizeof name, "%s_%lld", prefix, whole);
    set = run_make_set(cloud, name);
    if (set == NULL || run_add_member(set, cloud->count) < 0 || run_add_point(cloud, place, size) < 0)
        return fail(text, "point", "no memory");
    return 0;
}

static int read_peridigm(run_text *text, int dim, run_cloud *cloud) {
    while (run_text_next(text, blank, 1) > 0) {
        if (text->count != 5) return fail(text, "point", "is not: x y z block volume");
        if (add(text, cloud, dim, text->token, text->token[4], "block", text->token[3]) < 0) return -1;
    }
    return cloud->count > 0 ? 0 : fail(text, "points", "the file holds none");
}

typedef struct lammps {
    long long atoms; /* -1: not said yet */
    int       columns;
} lammps;

static int read_atoms(run_text *text, int dim, run_cloud *cloud, const lammps *header) {
    long long k, id;
    int       columns = header->columns;
    if (header->atoms < 0) return fail(text, "Atoms", "the header does not say how many atoms there are");
    for (k = 0; k < header->atoms; ++k) {
        int of_line, peri;
        if (run_text_next(text, blank, 1) == 0) return fail(text, "Atoms", "the file ends before the last atom");
        of_line = text->count == 8 || text->count == 10 ? text->count - 3 : text->count; /* three counts of images may follow */
        if (columns == 0) columns = of_line;
        peri = columns == 7;
        if ((columns != 5 && columns != 7) || of_line != columns)
            return fail(text, "Atoms", "is neither \"id type volume density x y z\" (peri) nor \"id type x y z\" (atomic)");
        if (run_whole(text->token[0], &id) < 0) return fail(text, "id", "is not a whole number");
        if (add(text, cloud, dim, text->token + (peri ? 4 : 2), peri ? text->token[2] : NULL, "type", text->token[1]) < 0) return -1;
    }
    return 0;
}

static int begins_section(const char *word) {
    static const char *const names[] = {"Masses", "Velocities", "Bonds", "Angles", "Dihedrals", "Impropers", "Pair", "PairIJ", "Bond",
                                        "Bodies", "Ellipsoids", "Lines", "Triangles"};
    size_t k;
    for (k = 0; k < sizeof names / sizeof *names; ++k)
        if (strcmp(word, names[k]) == 0) return 1;
    return 0;
}

/* The style behind "Atoms #"; '#' is a token of its own, or the head of one. */
static int style(run_text *text, lammps *header) {
    const char *word = text->count > 1 ? text->token[1] : "";
    header->columns = 0;
    if (*word == 0) return 0;
    if (*word == '#') word = word[1] != 0 ? word + 1 : text->count > 2 ? text->token[2] : "";
    if (strcmp(word, "peri") == 0) header->columns = 7;
    else if (strcmp(word, "atomic") == 0) header->columns = 5;
    else return fail(text, "Atoms", "of this style are not read: peri and atomic are");
    return 0;
}

static int read_lammps(run_text *text, int dim, run_cloud *cloud) {
    lammps header = {-1, 0};
    int    passed_over = 0, found = 0, k;
    while (run_text_next(text, blank, 0) > 0) {
        if (text->line == 1 || text->token[0][0] == '#') continue; /* the first line is a title */
        if (strcmp(text->token[0], "Atoms") == 0) {
            if (found++) return fail(text, "Atoms", "is given twice");
            if (style(text, &header) < 0 || read_atoms(text, dim, cloud, &header) < 0) return -1;
            passed_over = 0;
        } else if (begins_section(text->token[0])) passed_over = 1;
        else if (found && !passed_over) return fail(text, "Atoms", "more atoms than the header says");
        else if (!passed_over)
            for (k = 1; k < text->count && k < RUN_TOKENS; ++k)
                if (strcmp(text->token[k], "atoms") == 0 && k == 1)
                    if (run_whole(text->token[0], &header.atoms) < 0 || header.atoms < 0) return fail(text, "atoms", "is not a count");
    }
    return cloud->count > 0 ? 0 : fail(text, "Atoms", "the file holds none");
}

static int read_mesh(run_text *text, int format, int dim, run_cloud *cloud) {
    run_mesh mesh;
    int      result;
    memset(&mesh, 0, sizeof mesh);
    mesh.text = text;
    mesh.dim = dim;
    result = format == RUN_FORMAT_GMSH ? run_read_gmsh(&mesh) : run_read_abaqus(&mesh);
    if (result == 0) result = run_mesh_points(&mesh, cloud);
    run_mesh_free(&mesh);
    return result;
}

int run_read_cloud(run_text *text, int format, int dim, run_cloud *cloud) {
    int result;
    memset(cloud, 0, sizeof *cloud);
    if (format == RUN_FORMAT_PERIDIGM) result = read_peridigm(text, dim, cloud);
    else if (format == RUN_FORMAT_LAMMPS) result = read_lammps(text, dim, cloud);
    else result = read_mesh(text, format, dim, cloud);
    return result < 0 ? -1 : run_sort_sets(cloud);
}
