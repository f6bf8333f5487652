/* SPDX-License-Identifier: MIT */
/* test_clouds.c - uniform strain in the bulk of bodies that are no boxes of cubes: crystals, and meshes of tetrahedra, one point each.

   SOURCE OF TRUTH: the solid, W = 1/2 lambda (tr eps)^2 + mu eps:eps and its stress; and what docs/theory.md says of the moment
   correction (Corrections): where both ends of every bond see the same family, or its mirror image, each law is exact; elsewhere LPS
   is, whose halves have the weights that were fitted to their own family, and so is correspondence, which needs no fit. Bond-based
   bonds take the mean of both ends, and Oterkus's theta has a moment that is not fitted: both are off, by no more than is said there.
   Where families are symmetric about their points, forces balance by that symmetry alone. */
#include "solid.h"

enum { BODY_CENTRED, FACE_CENTRED, DIAMOND, TETRAHEDRA, MOVED, CLOUDS };
static const char *const cloud_name[] = {"bcc", "fcc", "diamond", "tetrahedra", "moved tetrahedra"};
static const double reach_of[CLOUDS] = {1.45, 1.25, 0.9, 1.25, 1.25}; /* horizon over the edge of a cube */
static const int    cells_of[CLOUDS] = {7, 6, 4, 6, 6};             /* cubes along an edge of the body */

typedef struct cloud {
    int     kind, count;
    double *x, *v;
} cloud;

/* A point of a cube at `at`. */
static void put_point(cloud *c, const int *at, const double *local, double volume) {
    for (int d = 0; d < 3; ++d) c->x[3 * c->count + d] = at[d] + local[d];
    c->v[c->count++] = volume;
}

/* Vertex of the mesh, moved by up to a fifth of a cube where it is inside; the same whenever it is asked for. */
static void vertex(const cloud *c, const int *at, double *p) {
    uint64_t seed = (uint64_t)((at[2] * 100 + at[1]) * 100 + at[0]);
    for (int d = 0; d < 3; ++d) {
        const double move = 0.2 * (2 * test_random(&seed) - 1);
        p[d] = at[d] + (c->kind == MOVED && at[d] > 0 && at[d] < cells_of[c->kind] ? move : 0);
    }
}

static double determinant(const double *a, const double *b, const double *c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* The six tetrahedra around a diagonal of the cube, each a point at its centroid with its volume. */
static void put_tetrahedra(cloud *c, const int *cube) {
    static const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}, origin[3] = {0, 0, 0};
    for (int t = 0; t < 6; ++t) {
        int at[3] = {cube[0], cube[1], cube[2]};
        double p[4][3], e[3][3], middle[3];
        vertex(c, at, p[0]);
        for (int a = 0; a < 3; ++a) {
            ++at[order[t][a]];
            vertex(c, at, p[a + 1]);
        }
        for (int d = 0; d < 3; ++d) {
            middle[d] = 0.25 * (p[0][d] + p[1][d] + p[2][d] + p[3][d]);
            for (int a = 0; a < 3; ++a) e[a][d] = p[a + 1][d] - p[0][d];
        }
        put_point(c, origin, middle, fabs(determinant(e[0], e[1], e[2])) / 6);
    }
}

static void put_cube(cloud *c, const int *at) {
    static const double bases[DIAMOND + 1][8][3] = {
        {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}},
        {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}},
        {{0.125, 0.125, 0.125}, {0.625, 0.625, 0.125}, {0.625, 0.125, 0.625}, {0.125, 0.625, 0.625},
         {0.375, 0.375, 0.375}, {0.875, 0.875, 0.375}, {0.875, 0.375, 0.875}, {0.375, 0.875, 0.875}}};
    static const int count[DIAMOND + 1] = {2, 4, 8};
    if (c->kind >= TETRAHEDRA) put_tetrahedra(c, at);
    else
        for (int k = 0; k < count[c->kind]; ++k) put_point(c, at, bases[c->kind][k], 1.0 / count[c->kind]);
}

static cloud cloud_of(int kind) {
    const int n = cells_of[kind];
    cloud c;
    int at[3];
    memset(&c, 0, sizeof c);
    c.kind = kind;
    c.x = (double *)calloc((size_t)(24 * n * n * n), sizeof *c.x);
    c.v = (double *)calloc((size_t)(8 * n * n * n), sizeof *c.v);
    for (at[2] = 0; at[2] < n; ++at[2])
        for (at[1] = 0; at[1] < n; ++at[1])
            for (at[0] = 0; at[0] < n; ++at[0]) put_cube(&c, at);
    return c;
}

/* The largest errors over the points whose own family and all families in it are whole, under the six strains and the isotropic one. */
typedef struct errors {
    double energy, mean, stress, force; /* of W, relative; of the stress, over the largest; force density times horizon over stress */
    int    points;
} errors;

static int is_deep(const cloud *c, int i) {
    for (int d = 0; d < 3; ++d)
        if (fmin(c->x[3 * i + d], cells_of[c->kind] - c->x[3 * i + d]) < 2 * reach_of[c->kind]) return 0;
    return 1;
}

static void note_errors(const cloud *c, const solid *s, peri_body *b, const double *eps, errors *e) {
    double h[9], sigma[6], size = 0, *w, *f, *stress;
    int i, k;
    strain_matrix(3, eps, h);
    stretch_by(b, h);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
    stress = get(b, PERI_FIELD_FORCE_STRESS);
    solid_stress(s, eps, sigma);
    for (k = 0; k < 6; ++k) size = fmax(size, fabs(sigma[k]));
    for (i = 0; i < c->count; ++i) {
        const double off = fabs(w[i] / solid_energy(s, eps) - 1);
        if (!is_deep(c, i)) continue;
        e->points++;
        e->mean += off;
        e->energy = fmax(e->energy, off);
        for (k = 0; k < 6; ++k) e->stress = fmax(e->stress, fabs(stress[6 * i + k] - sigma[k]) / size);
        for (k = 0; k < 3; ++k) e->force = fmax(e->force, fabs(f[3 * i + k]) * reach_of[c->kind] / size);
    }
    free(w);
    free(f);
    free(stress);
}

static errors errors_of(const cloud *c, int32_t law, int32_t correction) {
    solid s = solid_of(PERI_SPACE_SOLID, law, correction);
    errors e;
    peri_body *b;
    s.spacing = 1;
    s.ratio = reach_of[c->kind];
    memset(&e, 0, sizeof e);
    b = solid_new(&s);
    (void)MUST(b, peri_add_points(b, c->count, c->x, c->v, NULL));
    (void)MUST(b, peri_build(b));
    for (int number = 0; number <= 6; ++number) {
        double eps[6];
        for (int k = 0; k < 6; ++k) eps[k] = k == number || (number == 6 && k < 3) ? 1e-3 : 0;
        note_errors(c, &s, b, eps, &e);
    }
    CHECK(e.points > 0);
    e.mean /= e.points;
    printf("    %-16s %-14s %-6s %2d bonds: W off by %.1e (mean %.1e), stress %.1e, force x horizon/stress %.1e\n", cloud_name[c->kind],
           law_name[law % 100], correction_name[correction % 100], (int)peri_family_width(b), e.energy, e.mean, e.stress, e.force);
    peri_body_destroy(b);
    return e;
}

static void crystals(void) {
    for (int kind = BODY_CENTRED; kind <= DIAMOND; ++kind) {
        cloud c = cloud_of(kind);
        for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            const errors e = errors_of(&c, law, PERI_CORRECTION_MOMENT);
            CHECK(e.energy < 1e-10 && e.stress < 1e-10);
            if (kind != DIAMOND || law == PERI_LAW_CORRESPONDENCE) CHECK(e.force < 1e-10);
        }
        free(c.x);
        free(c.v);
    }
}

/* The bounds are the numbers of docs/theory.md. */
static void tetrahedra(void) {
    for (int kind = TETRAHEDRA; kind <= MOVED; ++kind) {
        cloud c = cloud_of(kind);
        const errors plain = errors_of(&c, PERI_LAW_BOND_BASED, PERI_CORRECTION_NONE);
        const errors bonds = errors_of(&c, PERI_LAW_BOND_BASED, PERI_CORRECTION_MOMENT);
        const errors lps = errors_of(&c, PERI_LAW_LPS, PERI_CORRECTION_MOMENT);
        const errors none = {0}, oterkus = kind == MOVED || test_long ? errors_of(&c, PERI_LAW_OTERKUS, PERI_CORRECTION_MOMENT) : none;
        const errors gradient = errors_of(&c, PERI_LAW_CORRESPONDENCE, PERI_CORRECTION_MOMENT);
        CHECK(lps.energy < 1e-10 && lps.stress < 1e-10);
        CHECK(gradient.energy < 1e-10 && gradient.stress < 1e-10);
        CHECK(oterkus.energy < 0.03 && oterkus.stress < 0.03);
        CHECK(bonds.energy < 0.2 && bonds.mean < 0.6 * plain.mean);
        free(c.x);
        free(c.v);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(crystals);
    RUN(tetrahedra);
    return test_end("test_clouds");
}
