/* SPDX-License-Identifier: MIT */
/* gallery.h - what the programs of the gallery share: they write tables to out/gallery, and what was found beside what is known;
   tools/gallery.py draws the tables and writes docs/gallery.md. */
#ifndef GALLERY_H
#define GALLERY_H

#include "../example.h"

/* Opens out/gallery/NAME.csv and writes the names of its columns. */
static inline FILE *table(const char *name, const char *columns) {
    char path[256];
    FILE *file;
    snprintf(path, sizeof path, "out/gallery/%s.csv", name);
    file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "cannot write %s: run from the root of peri, with the folder out/gallery made\n", path);
        exit(EXIT_FAILURE);
    }
    fprintf(file, "%s\n", columns);
    return file;
}

/* A line of out/gallery/SCENE.figures.csv: what was found, the reference, and how far off it may be (0: nothing is asked of it). */
static inline void figure(FILE *figures, const char *what, double value, double reference, double within, const char *unit) {
    fprintf(figures, "\"%s\",%.6g,%.6g,%.6g,%s\n", what, value, reference, within, unit);
    printf("  %-48s %10.4g   reference %10.4g   %s\n", what, value, reference, unit);
}

static inline FILE *figures_of(const char *scene) {
    char name[128];
    snprintf(name, sizeof name, "%s.figures", scene);
    return table(name, "what,value,reference,within,unit");
}

/* A copy of a field; free it. */
static inline double *field_of(peri_body *body, int32_t field) {
    const int64_t n = must(body, peri_size_of_field(body, field));
    double *copy = (double *)malloc((size_t)n * sizeof *copy);
    if (!copy) exit(EXIT_FAILURE);
    (void)must(body, peri_get_field(body, field, copy, n));
    return copy;
}

/* Position, displacement and a scalar field (of a vector or tensor: its component) of all points: x, y, ux, uy, value. */
static inline void map_of(const char *name, peri_body *body, int32_t field, int component) {
    const int64_t n = peri_point_count(body);
    const int64_t parts = must(body, peri_size_of_field(body, field)) / n;
    double *x = field_of(body, PERI_FIELD_POSITION), *u = field_of(body, PERI_FIELD_DISPLACEMENT), *f = field_of(body, field);
    FILE *file = table(name, "x,y,ux,uy,value");
    for (int64_t i = 0; i < n; ++i)
        fprintf(file, "%.7g,%.7g,%.7g,%.7g,%.7g\n", x[2 * i], x[2 * i + 1], u[2 * i], u[2 * i + 1], f[parts * i + component]);
    fclose(file);
    free(x);
    free(u);
    free(f);
}

/* ---- the bonds that broke, as peri_on_break tells them */

typedef struct broken_bonds {
    const double *x;          /* positions of the points */
    double       *at;         /* middle x, y and time of each */
    int64_t       count, room;
} broken_bonds;

static inline int32_t note_bond(void *user, int32_t i, int32_t j, double time, double stretch) {
    broken_bonds *bonds = (broken_bonds *)user;
    (void)stretch;
    if (bonds->count == bonds->room) {
        double *more = (double *)realloc(bonds->at, (size_t)(2 * bonds->room + 1024) * 3 * sizeof *more);
        if (!more) return -1;
        bonds->at = more;
        bonds->room = 2 * bonds->room + 1024;
    }
    for (int d = 0; d < 2; ++d) bonds->at[3 * bonds->count + d] = 0.5 * (bonds->x[2 * i + d] + bonds->x[2 * j + d]);
    bonds->at[3 * bonds->count++ + 2] = time;
    return 0;
}

/* Direction in degrees from (x, y) of the broken bonds between the distances `from` and `to`, on the side of (dx, dy), by least squares. */
static inline double direction(const broken_bonds *bonds, double x, double y, double from, double to, double dx, double dy) {
    double xx = 0, xy = 0, yy = 0, along;
    for (int64_t k = 0; k < bonds->count; ++k) {
        const double rx = bonds->at[3 * k] - x, ry = bonds->at[3 * k + 1] - y, r = hypot(rx, ry);
        if (r < from || r > to || rx * dx + ry * dy < 0) continue;
        xx += rx * rx;
        xy += rx * ry;
        yy += ry * ry;
    }
    along = 0.5 * atan2(2 * xy, xx - yy);
    if (cos(along) * dx + sin(along) * dy < 0) along += 3.14159265358979;
    return along * 57.29577951308232;
}

#endif
