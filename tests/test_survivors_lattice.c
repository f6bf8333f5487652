/* SPDX-License-Identifier: MIT */
/* test_survivors_lattice.c - what `make mutants` found that no other quick test looked at: families and weights, columns, laws side by
   side.

   SOURCE OF TRUTH: kernels agree to the rounding of sums; families and parts of cells by their definition; forces of bonds by hand; a point
   gives its half of its bonds by its own law, whatever its neighbours are made of. */
#include "scene.h"

#define CLOUD_MOST 2000

/* A lattice of nx by ny cells of edge 1, of which a test moves points, changes volumes, leaves some out; by the caller's own points. */
typedef struct lattice {
    int64_t count;
    double  x[2 * CLOUD_MOST], volume[CLOUD_MOST];
    int32_t material[CLOUD_MOST];
} lattice;

static lattice cloud;

static void fill(int nx, int ny) {
    int64_t i;
    cloud.count = (int64_t)nx * ny;
    for (i = 0; i < cloud.count; ++i) {
        cloud.x[2 * i] = (double)(i % nx) + 0.5;
        cloud.x[2 * i + 1] = (double)(i / nx) + 0.5;
        cloud.volume[i] = 1;
        cloud.material[i] = 0;
    }
}

static int32_t criterion = PERI_CRITERION_BOND_ENERGY; /* of laws with states */

/* The body of the cloud; material k of law k. */
static peri_body *body_of(const peri_body_desc *desc, const int32_t *laws, int materials, double critical) {
    peri_body *b = NULL;
    int32_t id[2] = {0, 0}, *material = (int32_t *)calloc((size_t)cloud.count, sizeof *material);
    int64_t i;
    int k;
    MUST(NULL, peri_body_create(desc, &b, NULL));
    for (k = 0; k < materials; ++k) {
        peri_material_desc m;
        peri_material_desc_init(&m, laws[k]);
        m.young = 1 + k;
        m.density = 1;
        if (laws[k] != PERI_LAW_BOND_BASED) m.poisson = 0.3;
        m.fracture_energy = k == 0 ? critical : 100 * critical;
        if (critical > 0 && laws[k] != PERI_LAW_BOND_BASED) m.criterion = criterion;
        id[k] = (int32_t)MUST(b, peri_add_material(b, &m));
    }
    for (i = 0; i < cloud.count; ++i) material[i] = id[cloud.material[i]];
    MUST(b, peri_add_points(b, cloud.count, cloud.x, cloud.volume, material));
    MUST(b, peri_build(b));
    free(material);
    return b;
}

static peri_body_desc plane(double horizon, int32_t kernel) {
    peri_body_desc d;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRAIN;
    d.geometry = PERI_GEOMETRY_LINEAR;
    d.horizon = horizon;
    d.kernel = kernel;
    d.threads = 1;
    return d;
}

/* Forces of a random motion, and what they have broken after two steps of it, by the best kernel and by the reference. */
static int64_t most_broken; /* by the last of these */
static void check_kernels(peri_body_desc d, const int32_t *laws, int materials, const char *text, double critical, double size) {
    double *f[2];
    int64_t n = 2 * cloud.count, broken[2], i;
    double apart = 0, *u = random_field(n, size, 3), *v = random_field(n, size, 8);
    peri_body *b[2];
    int k;
    for (k = 0; k < 2; ++k) {
        d.kernel = k ? PERI_KERNEL_REFERENCE : PERI_KERNEL_BEST;
        b[k] = body_of(&d, laws, materials, critical);
        if (k == 0 && text) CHECK(strncmp(peri_kernel_text(b[k]), text, strlen(text)) == 0);
        put(b[k], PERI_FIELD_DISPLACEMENT, u);
        f[k] = get(b[k], PERI_FIELD_FORCE_DENSITY);
        put(b[k], PERI_FIELD_DISPLACEMENT, v); /* another way to the same bonds: work is not that of one straight motion */
        (void)go(b[k], PERI_INTEGRATOR_VELOCITY_VERLET, 2, 1e-4, 0);
        broken[k] = peri_broken_count(b[k]);
    }
    for (i = 0; i < n; ++i) apart = fmax(apart, fabs(f[0][i] - f[1][i]));
    CHECK(apart <= 1e-12 * largest(f[1], n));
    CHECK(broken[0] == broken[1] && (broken[1] > 0) == (critical > 0));
    most_broken = broken[1];
    if (critical > 0) { /* the very same bonds */
        double *p = get(b[0], PERI_FIELD_DAMAGE), *q = get(b[1], PERI_FIELD_DAMAGE);
        for (i = 0; i < cloud.count; ++i) test_bad += fabs(p[i] - q[i]) > 1e-6;
        free(p);
        free(q);
    }
    for (k = 0; k < 2; ++k) {
        free(f[k]);
        peri_body_destroy(b[k]);
    }
    free(u);
    free(v);
}

static const int32_t bonds[2] = {PERI_LAW_BOND_BASED, PERI_LAW_BOND_BASED}, states[2] = {PERI_LAW_LPS, PERI_LAW_LPS};

/* Groups that are alike but for one point, for volumes, for materials: each has its own columns. */
static void groups_that_differ(void) {
    const peri_body_desc d = plane(2.1, PERI_KERNEL_BEST);
    int64_t i;
    fill(64, 16); /* a power of 2: sums of volumes, and differences of places, are exact */
    check_kernels(d, bonds, 1, "columns", 0, 0.01);
    cloud.x[2 * (4 * 64 + 28)] += 0.0009765625; /* lane 12 of a group in the middle: no family is larger or smaller for it */
    check_kernels(d, bonds, 1, "columns", 0, 0.01);
    fill(64, 16);
    for (i = 0; i < cloud.count; ++i) cloud.volume[i] = i % 64 < 11 || i % 64 >= 43 ? 0.75 : 1.25;
    check_kernels(d, bonds, 1, "columns", 0, 0.01);
    for (i = 0; i < cloud.count; ++i) cloud.volume[i] = i / 64 < 8 ? 0.75 : 1.25;
    check_kernels(d, bonds, 1, "columns", 0, 0.01);
    fill(64, 16);
    for (i = 0; i < cloud.count; ++i) cloud.material[i] = i / 64 > 7;
    check_kernels(d, bonds, 2, "columns", 0, 0.01);
    check_kernels(d, states, 2, "columns", 0, 0.01);
}

/* Work on bonds of groups that share their columns, of two limits, of parts of cells; down to the last bonds that break. */
static void work_by_columns(void) {
    peri_body_desc d = plane(2.1, PERI_KERNEL_BEST);
    int64_t i;
    uint64_t seed = 3;
    int kind;
    for (kind = 0; kind < 8; ++kind) {
        double critical = 1e-3;
        criterion = kind < 5 ? PERI_CRITERION_BOND_ENERGY : PERI_CRITERION_NODE_ENERGY;
        fill(32, 8);
        for (i = 0; i < cloud.count; ++i) cloud.material[i] = kind % 4 == 1 || kind == 4 ? i % 32 > 14 : kind % 4 == 2 ? i % 32 < 14 : 0;
        for (i = 0; kind == 4 && i < 2 * cloud.count; ++i) cloud.x[i] += 0.1 * test_random(&seed); /* no lattice: a list */
        d.quadrature = kind % 4 == 3 ? PERI_QUADRATURE_PARTIAL : PERI_QUADRATURE_FULL;
        most_broken = 100;
        for (; most_broken > 30 && critical < 1; critical *= kind < 5 ? 1.5 : 1.2)
            check_kernels(d, states, kind == 0 || kind % 4 == 3 ? 1 : 2, kind == 4 ? NULL : "columns", critical, 0.05);
    }
}

/* A third of the sites, any of them: columns would be mostly empty. */
static void few_of_the_sites(void) {
    uint64_t seed = 4;
    int64_t i, kept = 0;
    fill(40, 40);
    for (i = 0; i < cloud.count; ++i) {
        if (test_random(&seed) > 0.35) continue;
        cloud.x[2 * kept] = cloud.x[2 * i];
        cloud.x[2 * kept + 1] = cloud.x[2 * i + 1];
        ++kept;
    }
    cloud.count = kept;
    check_kernels(plane(3.1, PERI_KERNEL_BEST), bonds, 1, "list", 0, 0.01);
}

/* Families of more points than a row has room for: all are in all of them; energy of isotropic strain e of a pair is c e^2 |xi|/4. */
static void wide_families(void) {
    peri_body_desc d = plane(60, PERI_KERNEL_BEST);
    int64_t i, j, bad = 0;
    double c = 0, *u, *w;
    int32_t *row;
    fill(34, 34);
    d.kernel = PERI_KERNEL_LIST;
    peri_body *b = body_of(&d, bonds, 1, 0);
    const int32_t width = peri_family_width(b);
    CHECK(width == cloud.count - 1);
    row = (int32_t *)calloc((size_t)width, sizeof *row);
    for (i = 0; i < cloud.count; i += 97) {
        MUST(b, peri_get_families(b, i, 1, row, width));
        for (j = 0; j < width; ++j) bad += row[j] != j + (j >= i);
    }
    MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c, NULL));
    u = (double *)calloc((size_t)(2 * cloud.count), sizeof *u);
    for (i = 0; i < 2 * cloud.count; ++i) u[i] = 1e-3 * cloud.x[i];
    put(b, PERI_FIELD_DISPLACEMENT, u);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (i = 0; i < cloud.count; i += 97) {
        double sum = 0;
        for (j = 0; j < cloud.count; ++j) sum += hypot(cloud.x[2 * j] - cloud.x[2 * i], cloud.x[2 * j + 1] - cloud.x[2 * i + 1]);
        bad += fabs(w[i] / (0.25 * c * 1e-6 * sum) - 1) > 1e-10;
    }
    CHECK(bad == 0);
    free(row);
    free(u);
    free(w);
    peri_body_destroy(b);
}

/* Both ends of a bond feel the same force, to the last bit, of whatever their materials are: moving j by u does to i what moving i by -u
   does to j, where volumes are equal. */
static void ends_are_opposite(void) {
    const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE};
    const int64_t n = 32 * 6;
    int p;
    fill(32, 6);
    for (int64_t i = 0; i < n; ++i) { /* the highest row comes first, so that the two ends of a vector come of different pairs of points */
        cloud.x[2 * i] = 0.1 * cloud.x[2 * i] + 0.037;
        cloud.x[2 * i + 1] = 0.1 * (i < 32 ? 5.5 : cloud.x[2 * i + 1] - 1) + 0.73;
        cloud.volume[i] = 0.01;
        cloud.material[i] = i % 32 > 12;
    }
    for (p = 0; p < 3; ++p) {
        peri_body_desc d = plane(0.31, PERI_KERNEL_BEST);
        int64_t i, j, bad = 0;
        d.precision = precisions[p];
        d.influence = PERI_INFLUENCE_GAUSSIAN;
        peri_body *b = body_of(&d, bonds, 2, 0);
        CHECK(strncmp(peri_kernel_text(b), "columns", 7) == 0);
        double *force = (double *)calloc((size_t)(2 * n * 2 * n), sizeof *force), *u = (double *)calloc((size_t)(2 * n), sizeof *u);
        for (i = 0; i < n; ++i) { /* i by +u and by -u */
            for (int side = 0; side < 2; ++side) {
                u[2 * i] = side ? -0.0078125 : 0.0078125; /* a power of 2 */
                put(b, PERI_FIELD_DISPLACEMENT, u);
                MUST(b, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, &force[(2 * i + side) * 2 * n], 2 * n));
            }
            u[2 * i] = 0;
        }
        for (i = 0; i < n; ++i)
            for (j = 0; j < n; ++j) bad += i != j && force[2 * j * 2 * n + 2 * i] != -force[(2 * i + 1) * 2 * n + 2 * j];
        CHECK(bad == 0);
        CHECK(fabs(force[2]) > 0);
        free(force);
        free(u);
        peri_body_destroy(b);
    }
}

/* ---- laws side by side --------------------------------------------------------------------------------------------- */

/* Energy densities of a random motion; the right half is of the second law. */
static double *energies(int32_t first, int32_t second) {
    const int32_t laws[2] = {first, second};
    double *u = random_field(2 * cloud.count, 0.01, 6);
    int64_t i;
    for (i = 0; i < cloud.count; ++i) cloud.material[i] = i % 12 > 5;
    const peri_body_desc d = plane(3.1, PERI_KERNEL_BEST);
    peri_body *b = body_of(&d, laws, 2, 0);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    double *w = get(b, PERI_FIELD_ENERGY_DENSITY);
    free(u);
    peri_body_destroy(b);
    return w;
}

/* A point of a law with states to its right has the energy of its own half of its bonds, whichever law that is. */
static void neighbours_of_any_law(void) {
    const int32_t laws[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};
    int a, c;
    int64_t i, bad = 0;
    fill(12, 8);
    for (a = 0; a < 4; ++a) {
        double *w[4] = {NULL, NULL, NULL, NULL};
        for (c = 1; c < 4; ++c) w[c] = energies(laws[a], laws[c]);
        for (c = 2; c < 4; ++c)
            for (i = 0; i < cloud.count; ++i) bad += i % 12 < 6 && fabs(w[c][i] - w[1][i]) > 1e-11 * w[1][i];
        for (c = 1; c < 4; ++c) free(w[c]);
    }
    CHECK(bad == 0);
    /* bonds next to states have the c of their material: isotropic strain e gives them c e^2 sum |xi| V/4 */
    const int32_t pair[2] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS};
    const peri_body_desc d = plane(3.1, PERI_KERNEL_BEST);
    double c0 = 0, u[2 * 96], *w;
    peri_body *b = body_of(&d, pair, 2, 0);
    MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &c0, NULL));
    for (i = 0; i < 2 * cloud.count; ++i) u[i] = 1e-3 * cloud.x[i];
    put(b, PERI_FIELD_DISPLACEMENT, u);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    for (i = 0; i < cloud.count; ++i) {
        double sum = 0;
        int64_t j;
        for (j = 0; j < cloud.count; ++j) {
            const double bond = hypot(cloud.x[2 * j] - cloud.x[2 * i], cloud.x[2 * j + 1] - cloud.x[2 * i + 1]);
            if (bond < 3.1) sum += bond;
        }
        bad += i % 12 < 6 && fabs(w[i] / (0.25 * c0 * 1e-6 * sum) - 1) > 1e-10;
    }
    CHECK(bad == 0);
    free(w);
    peri_body_destroy(b);
}

/* A material that breaks by an energy has no critical stretch, also beside one that has: strained by 5e-3 its bonds have taken a hundredth
   of w0 and less. */
static void energies_are_no_stretch(void) {
    const double lo[2] = {0, 0}, middle[2] = {6, 6}, right[2] = {6, 0}, hi[2] = {12, 6};
    const peri_body_desc d = plane(3.1, PERI_KERNEL_BEST);
    double s0 = 0, w0 = 0, u[144];
    peri_material_desc m;
    peri_body *b = NULL;
    int k;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    peri_material_desc_init(&m, PERI_LAW_LPS);
    m.young = m.density = 1;
    m.poisson = 0.3;
    m.critical_stretch = 1;
    const int32_t first = (int32_t)MUST(b, peri_add_material(b, &m));
    m.critical_stretch = 0;
    m.fracture_energy = 0.05;
    m.criterion = PERI_CRITERION_BOND_ENERGY;
    const int32_t second = (int32_t)MUST(b, peri_add_material(b, &m));
    MUST(b, peri_add_box(b, first, lo, middle, 1));
    MUST(b, peri_add_box(b, second, right, hi, 1));
    MUST(b, peri_build(b));
    MUST(b, peri_get_bond_constants(b, second, second, NULL, &s0));
    MUST(b, peri_get_critical_energy(b, second, &w0));
    CHECK(s0 == HUGE_VAL && w0 > 1e-3 && w0 < 4e-3);
    MUST(b, peri_get_field(b, PERI_FIELD_POSITION, u, 144));
    for (k = 0; k < 144; ++k) u[k] *= 5e-3;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 2, 1e-4, 0);
    CHECK(peri_broken_count(b) == 0);
    peri_body_destroy(b);
}

/* The term of docs/theory.md against modes of no energy, of one point i in the middle that moves by u: t = k w (eta - H xi), k = G B/m with
   B = 8 mu; H_i = 0 by symmetry, H_j = u xi V K^-1 with K = m/2: f_i = -G B u/m sum V (2 - 2 |xi|^2 V/m). */
static void stabilization_is_that_of_the_law(void) {
    const int n = 13;
    double *f[2], u[2 * 169] = {0}, sum = 0, m = 0;
    const double mu = 1 / 2.6;
    int k, i, j;
    for (i = -3; i <= 3; ++i)
        for (j = -3; j <= 3; ++j)
            if (i * i + j * j > 0 && i * i + j * j <= 9) m += i * i + j * j;
    for (i = -3; i <= 3; ++i)
        for (j = -3; j <= 3; ++j)
            if (i * i + j * j > 0 && i * i + j * j <= 9) sum += 2 - 2 * (i * i + j * j) / m;
    u[2 * 84] = 0.01;
    for (k = 0; k < 2; ++k) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_CORRESPONDENCE, 0.3, 1, 3, n, n, 1);
        s.material.stabilization = k ? 0.3 : 0;
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        peri_body *b = specimen_make(&s);
        put(b, PERI_FIELD_DISPLACEMENT, u);
        f[k] = get(b, PERI_FIELD_FORCE_DENSITY);
        peri_body_destroy(b);
    }
    CHECK_NEAR(f[1][2 * 84] - f[0][2 * 84], -0.3 * 8 * mu * 0.01 / m * sum, 1e-10, 0);
    free(f[0]);
    free(f[1]);
}

/* A point of a law with a gradient that is left with one bond acts by its spring, B/m of its whole family: W = B e^2 V/(2 m). */
static int32_t all_but_one(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)xi, (void)xj;
    return (i == 84 || j == 84) && !(i == 84 && j == 85);
}
static void springs_of_what_is_left(void) {
    const double mu = 1 / 2.6;
    double u[2 * 169] = {0}, m = 0, *w;
    int i, j;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_CORRESPONDENCE, 0.3, 1, 3, 13, 13, 1);
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s);
    for (i = -3; i <= 3; ++i)
        for (j = -3; j <= 3; ++j)
            if (i * i + j * j <= 9) m += i * i + j * j;
    MUST(b, peri_cut_if(b, PERI_CUT_NOW, all_but_one, NULL));
    u[2 * 84] = -0.01;
    put(b, PERI_FIELD_DISPLACEMENT, u);
    w = get(b, PERI_FIELD_ENERGY_DENSITY);
    CHECK_NEAR(w[84], 8 * mu * 1e-4 / (2 * m), 1e-10, 0);
    free(w);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(groups_that_differ);
    RUN(work_by_columns);
    RUN(few_of_the_sites);
    RUN(wide_families);
    RUN(ends_are_opposite);
    RUN(neighbours_of_any_law);
    RUN(energies_are_no_stretch);
    RUN(stabilization_is_that_of_the_law);
    RUN(springs_of_what_is_left);
    return test_end("test_survivors_lattice");
}
