/* SPDX-License-Identifier: MIT */
/* pieces.h - random bodies that fall to pieces, and which pieces they are: a plain flood fill over what peri_get_families lists and
   peri_bond_is_intact answers. */
#ifndef PIECES_H
#define PIECES_H

#include "scene.h"

static uint64_t dice;
static int throw_die(int sides) { return (int)(test_random(&dice) * sides); }
static double between(double lo, double hi) { return lo + (hi - lo) * test_random(&dice); }

static inline int32_t in_ball(void *user, int64_t index, const double *x) {
    (void)user, (void)index;
    return (x[0] - 2) * (x[0] - 2) + (x[1] - 1) * (x[1] - 1) < 0.8;
}

/* Boxes, perturbed boxes, shapes, clouds, and two of them beside each other; unit square or cube to one and a half of it. */
enum { BOX, PERTURBED, SHAPE, CLOUD, TWO, SOURCES };

static inline void add_source(peri_body *b, int32_t material, int source, int dim) {
    const double lo[3] = {1, 0.5, -3}, hi[3] = {2.1, 1.4, -2.2}, far[3] = {3, 1.4, -2.2}, other[3] = {2.1, 0.5, -3};
    const double spacing = dim == 2 ? 0.1 : 0.2;
    double x[600], volumes[200];
    if (source == BOX || source == TWO) MUST(b, peri_add_box(b, material, lo, hi, spacing));
    if (source == PERTURBED) MUST(b, peri_add_perturbed_box(b, material, lo, hi, spacing, between(0, 1), (uint64_t)throw_die(1000)));
    if (source == SHAPE) MUST(b, peri_add_shape(b, material, lo, far, spacing, in_ball, NULL));
    if (source == TWO) MUST(b, peri_add_box(b, material, other, far, spacing));
    if (source != CLOUD) return;
    for (int k = 0; k < 200; ++k) {
        for (int d = 0; d < dim; ++d) x[k * dim + d] = between(lo[d], hi[d]);
        volumes[k] = between(0.5, 1.5) * pow(spacing, dim);
    }
    MUST(b, peri_add_points(b, 200, x, volumes, NULL));
}

static inline peri_body *random_body(int source, int dim) {
    peri_body_desc d;
    peri_material_desc m;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = dim == 2 ? PERI_SPACE_PLANE_STRESS : PERI_SPACE_SOLID;
    d.horizon = (dim == 2 ? 0.1 : 0.2) * (source == CLOUD ? 2.5 : between(1.2, 3.1));
    d.precision = PERI_PRECISION_DOUBLE + throw_die(3);
    d.kernel = PERI_KERNEL_BEST + throw_die(3);
    d.thickness = 0.3;
    d.threads = 1;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED + throw_die(2));
    m.young = 3;
    m.density = 7;
    if (m.law != PERI_LAW_BOND_BASED) m.poisson = 0.3;
    const int32_t material = (int32_t)MUST(b, peri_add_material(b, &m));
    add_source(b, material, source, dim);
    return b;
}

/* Points of clouds may have no neighbour: then another one. */
static inline peri_body *random_scene(int source, int dim) {
    for (;;) {
        peri_body *b = random_body(source, dim);
        const int32_t status = peri_build(b);
        if (status == PERI_OK) return b;
        CHECK(source == CLOUD && status == PERI_ERROR_FAMILY);
        peri_body_destroy(b);
    }
}

/* A straight cut through all of it. */
typedef struct knife {
    double normal[3], at;
    int    dim;
} knife;
static inline int32_t by_knife(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const knife *k = (const knife *)user;
    double a = -k->at, b = -k->at;
    (void)i, (void)j;
    for (int d = 0; d < k->dim; ++d) a += k->normal[d] * xi[d], b += k->normal[d] * xj[d];
    return a * b < 0;
}

static inline void break_some(peri_body *b) {
    const int dim = peri_dimension(b), way = throw_die(4);
    const double centre[3] = {between(1, 2), between(0.6, 1.3), between(-2.9, -2.3)};
    if (way == 0) return;
    if (way == 1) { /* crumbs */
        chance c = {(uint64_t)throw_die(100000), between(0, 1)};
        MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_chance, &c));
    } else if (way == 2) {
        knife k = {{between(-1, 1), between(-1, 1), between(-1, 1)}, 0, dim};
        for (int d = 0; d < dim; ++d) k.at += k.normal[d] * centre[d];
        MUST(b, peri_cut_if(b, PERI_CUT_NOW, by_knife, &k));
    } else if (dim == 2) { /* cracks that end within */
        const double to[2] = {between(1, 2), between(0.6, 1.3)};
        MUST(b, peri_cut_segment(b, PERI_CUT_NOW, centre, to));
    } else {
        const double normal[3] = {1, between(-1, 1), between(-1, 1)};
        MUST(b, peri_cut_disc(b, PERI_CUT_NOW, centre, normal, between(0.2, 0.7)));
    }
}

/* piece[points] = the least point of its piece. */
static inline void flood(peri_body *b, int32_t *piece) {
    const int32_t n = (int32_t)peri_point_count(b), width = peri_family_width(b);
    int32_t *rows = (int32_t *)malloc((size_t)n * (size_t)width * sizeof *rows), *stack = (int32_t *)malloc((size_t)n * sizeof *stack);
    MUST(b, peri_get_families(b, 0, n, rows, (int64_t)n * width));
    for (int32_t i = 0; i < n; ++i) piece[i] = -1;
    for (int32_t i = 0; i < n; ++i) {
        int32_t left = 0;
        if (piece[i] >= 0) continue;
        piece[i] = i;
        stack[left++] = i;
        while (left > 0) {
            const int32_t at = stack[--left];
            for (int32_t k = 0; k < width; ++k) {
                const int32_t j = rows[at * width + k];
                if (j == at || piece[j] >= 0 || peri_bond_is_intact(b, at, j) != 1) continue;
                piece[j] = i;
                stack[left++] = j;
            }
        }
    }
    free(rows);
    free(stack);
}

static inline double *field(peri_body *b, int32_t which) {
    const int64_t n = peri_size_of_field(b, which);
    double *values = (double *)malloc((size_t)n * sizeof *values);
    MUST(b, peri_get_field(b, which, values, n));
    return values;
}

/* Places and velocities at random, of the order of a spacing. */
static inline void move_about(peri_body *b) {
    const int64_t n = peri_point_count(b) * peri_dimension(b);
    double *in = (double *)malloc((size_t)n * sizeof *in);
    for (int pass = 0; pass < 2; ++pass) {
        for (int64_t k = 0; k < n; ++k) in[k] = between(-0.05, 0.1);
        MUST(b, peri_set_field(b, pass ? PERI_FIELD_VELOCITY : PERI_FIELD_DISPLACEMENT, in, n));
    }
    free(in);
}

#endif
