/* SPDX-License-Identifier: MIT */
/* scene.h - small bodies for the tests of motion, and the few lines around the calls that they all need. */
#ifndef SCENE_H
#define SCENE_H

#include "specimen.h"

#define PI      3.14159265358979323846
#define ULP64   1.1102230246251565e-16 /* unit roundoff: half the distance from 1 to the next double, float               */
#define ULP32   5.9604644775390625e-08
#define H       0.1 /* spacing of most bodies here                                                                        */
#define YOUNG   3.0
#define DENSITY 2.0
#define THICK   0.5 /* of the 2D bodies                                                                                   */

static inline double thickness(int32_t space) { return space == PERI_SPACE_SOLID ? 1.0 : THICK; }

/* By value % 100. */
static const char *const law_name[] = {"", "bond-based", "LPS", "Oterkus", "correspondence"};
static const char *const space_name[] = {"", "plane stress", "plane strain", "solid"};

static inline int dim_of(int32_t space) { return space == PERI_SPACE_SOLID ? 3 : 2; }
static inline int32_t all_axes(int dim) { return dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY; }

/* Poisson ratio of central springs: 1/3 in plane stress, else 1/4 ([T] 1.2, [P] A). */
static inline double bond_nu(int32_t space) { return space == PERI_SPACE_PLANE_STRESS ? 1.0 / 3.0 : 0.25; }

/* Entry (a, b) of a tensor field: xx yy xy, or xx yy zz xy yz xz. */
static inline int packed(int dim, int a, int b) {
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    return dim == 2 ? (a == b ? a : 2) : place[a][b];
}

/* Of the solid of modulus YOUNG, in 2D of its plane: W = 1/2 lambda (tr eps)^2 + mu eps:eps, bulk = lambda + 2 mu/D, so that an isotropic
   strain s has the energy 1/2 bulk (D s)^2; a and b: A, B of LPS (DESIGN section 2). */
typedef struct moduli {
    double lambda, mu, bulk, a, b;
} moduli;

static inline moduli moduli_of(int32_t space, double nu) {
    const int dim = dim_of(space);
    moduli m;
    m.mu = YOUNG / (2 * (1 + nu));
    m.lambda = space == PERI_SPACE_PLANE_STRESS ? YOUNG * nu / (1 - nu * nu) : YOUNG * nu / ((1 + nu) * (1 - 2 * nu));
    m.bulk = m.lambda + 2 * m.mu / dim;
    m.a = dim == 3 ? 3 * m.bulk - 5 * m.mu : 2 * m.lambda - 2 * m.mu;
    m.b = dim == 3 ? 15 * m.mu : 8 * m.mu;
    return m;
}

/* Micromodulus for a constant influence function: plane stress and strain [P] C.15, C.18 (per thickness), 3D [T] 1.24. */
static inline double micromodulus(int32_t space, double young, double horizon) {
    if (space == PERI_SPACE_PLANE_STRESS) return 9.0 * young / (PI * pow(horizon, 3.0));
    if (space == PERI_SPACE_PLANE_STRAIN) return 48.0 * young / (5.0 * PI * pow(horizon, 3.0));
    return 12.0 * young / (PI * pow(horizon, 4.0)); /* 18 K/(pi h^4), K = 2E/3 */
}

static inline peri_body *empty(int32_t space, int32_t precision, int32_t geometry, double horizon) {
    peri_body_desc d;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = space;
    d.precision = precision;
    d.geometry = geometry;
    d.horizon = horizon;
    d.threads = 1; /* these bodies are too small to share */
    if (space != PERI_SPACE_SOLID) d.thickness = THICK;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    return b;
}

static inline int32_t unbreakable(peri_body *b, double young, double density) {
    peri_material_desc m;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = young;
    m.density = density;
    return (int32_t)MUST(b, peri_add_material(b, &m));
}

/* A block of nx x ny (x nz) cells of size H with one corner at the origin, horizon 3 H. */
static inline peri_body *block(int32_t space, int32_t precision, int32_t geometry, int nx, int ny, int nz) {
    specimen s = specimen_of(space, PERI_LAW_BOND_BASED, 0, H, 3, nx, ny, nz);
    s.desc.precision = precision;
    s.desc.geometry = geometry;
    s.desc.thickness = thickness(space);
    s.material.young = YOUNG;
    s.material.density = DENSITY;
    peri_body *b = specimen_make(&s);
    CHECK(peri_point_count(b) == nx * ny * (space == PERI_SPACE_SOLID ? nz : 1));
    return b;
}

static inline double *get(peri_body *b, int32_t field) {
    int64_t n = MUST(b, peri_size_of_field(b, field));
    double *x = (double *)calloc((size_t)(n < 0 ? 0 : n) + 1, sizeof *x);
    (void)MUST(b, peri_get_field(b, field, x, n));
    return x;
}

static inline void put(peri_body *b, int32_t field, const double *x) {
    (void)MUST(b, peri_set_field(b, field, x, peri_size_of_field(b, field)));
}

/* `steps` steps of dt; dt = 0 takes the default. */
static inline int32_t go(peri_body *b, int32_t integrator, int64_t steps, double dt, double damping) {
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.integrator = integrator;
    r.steps = steps;
    r.time_step = dt;
    r.damping = damping;
    return (int32_t)MUST(b, peri_advance(b, &r));
}

static inline double *random_field(int64_t n, double amplitude, uint64_t seed) {
    double *v = (double *)calloc((size_t)n + 1, sizeof *v);
    int64_t k;
    for (k = 0; k < n; ++k) v[k] = amplitude * (2 * test_random(&seed) - 1);
    return v;
}

static inline double largest(const double *v, int64_t n) {
    double most = 0;
    int64_t k;
    for (k = 0; k < n; ++k) most = fmax(most, fabs(v[k]));
    return most;
}

#endif
