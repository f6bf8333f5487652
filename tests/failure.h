/* SPDX-License-Identifier: MIT */
/* failure.h - bodies of the state-based laws for the tests of their failure, their states and their memory. */
#ifndef FAILURE_H
#define FAILURE_H

#include "pool.h"
#include "scene.h"

#define CRITICAL 0.02 /* stretch, where bonds break */

typedef struct kind { /* what is simulated; limit: critical stretch, or fracture energy of the energy criteria; 0 = none */
    int32_t space, law, criterion;
    double  poisson, limit;
} kind;

static const char *const criterion_name[4] = {"", "stretch", "bond energy", "node energy"};

/* G0 whose bond-based critical stretch for w = 1 is CRITICAL: limits of all criteria are then of the same size. */
static inline double toughness(int32_t space) {
    const double h = 3 * H;
    if (space == PERI_SPACE_PLANE_STRESS) return CRITICAL * CRITICAL * 9 * YOUNG * h / (4 * PI);
    if (space == PERI_SPACE_PLANE_STRAIN) return CRITICAL * CRITICAL * 12 * YOUNG * h / (5 * PI);
    return CRITICAL * CRITICAL * 6 * YOUNG * h / 5;
}
/* What the node energy criterion divides the w0 of a bond by, on live families, at `across` spacings to the horizon: docs/theory.md, fitted
   to the strips of test_toughness.c. */
static inline double node_share(int32_t space, int32_t law, double across) {
    const int whole = law == PERI_LAW_CORRESPONDENCE;
    if (space == PERI_SPACE_SOLID) return whole ? 15.5 * (1 - 1.35 / across) : 12 * (1 - 1.4 / across);
    return whole ? 13.3 * (1 - 1.42 / across) : 9.4 * (1 - 1.45 / across);
}

static inline kind kind_of(int32_t space, int32_t law, int32_t criterion, double nu) {
    kind k = {0, 0, 0, 0, 0};
    k.space = space;
    k.law = law;
    k.criterion = criterion;
    k.poisson = nu;
    k.limit = criterion == PERI_CRITERION_STRETCH ? CRITICAL : toughness(space);
    if (criterion == PERI_CRITERION_NODE_ENERGY) k.limit *= node_share(space, law, 3); /* the w0 of a bond of `toughness` */
    return k;
}

static inline peri_material_desc stuff(kind k) {
    peri_material_desc m;
    peri_material_desc_init(&m, k.law);
    m.young = YOUNG;
    m.density = DENSITY;
    if (k.law != PERI_LAW_BOND_BASED) m.poisson = k.poisson;
    m.criterion = k.criterion;
    if (k.criterion == PERI_CRITERION_STRETCH) m.critical_stretch = k.limit;
    else m.fracture_energy = k.limit;
    return m;
}

/* Serial, horizon 3 H, thickness THICK. */
static inline peri_body_desc plan(int32_t space) {
    specimen s = specimen_of(space, PERI_LAW_BOND_BASED, 0, H, 3, 1, 1, 1);
    s.desc.thickness = thickness(space);
    return s.desc;
}

/* A box of nx x ny (x nz) cells of size H with one corner at the origin, of one material, built. */
static inline peri_body *make(const peri_body_desc *d, kind k, int nx, int ny, int nz) {
    specimen s = specimen_of(k.space, k.law, k.poisson, H, 3, nx, ny, nz);
    s.desc = *d;
    s.material = stuff(k);
    return specimen_make(&s);
}

static inline peri_body *box(kind k, int32_t geometry, int nx, int ny, int nz) {
    peri_body_desc d = plan(k.space);
    d.geometry = geometry;
    return make(&d, k, nx, ny, nz);
}

/* Points between the planes x = from and x = to. */
static inline int32_t slab(peri_body *b, double from, double to) {
    const double lo[3] = {from, -1e3, -1e3}, hi[3] = {to, 1e3, 1e3};
    return (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
}

static inline int32_t *rows_of(peri_body *b) {
    int64_t n = peri_point_count(b) * peri_family_width(b);
    int32_t *rows = (int32_t *)calloc((size_t)n + 1, sizeof *rows);
    (void)MUST(b, peri_get_families(b, 0, peri_point_count(b), rows, n));
    return rows;
}

static inline double far(const double *x, int dim, int64_t i, int64_t j) {
    double sum = 0;
    int d;
    for (d = 0; d < dim; ++d) sum += (x[j * dim + d] - x[i * dim + d]) * (x[j * dim + d] - x[i * dim + d]);
    return sqrt(sum);
}

#endif
