/* SPDX-License-Identifier: MIT */
/* test_cell_bodies.c - bodies made of the caller's cells: uniform strain, a tensile specimen, what is refused, memory.

   SOURCE OF TRUTH: the patch test: held as a uniform strain asks in an outer layer as thick as bonds are long, a homogeneous body follows
   it inside. A tensile specimen of uniform cross-section A has the force E A strain. A call that fails has changed nothing. */
#include "cell_mesh.h"
#include "pool.h"

/* ---- uniform strain --------------------------------------------------------------------------------------------------- */

#define LONGEST 0.8 /* what bonds of partial cells are longer than the horizon                                              */

/* Largest error of the displacement inside, over 1e-3 horizons. */
static double patch(const cell_mesh *m, const solid *s) {
    static const double strain[9] = {1e-3, 3e-4, 0, 2e-4, -5e-4, 1e-4, 0, 4e-4, 7e-4};
    peri_body *b = mesh_body(m, s);
    const int64_t n = peri_point_count(b);
    const int dim = m->dim;
    double *x = get(b, PERI_FIELD_POSITION), *u, *want = (double *)calloc((size_t)(n * dim), sizeof *want), worst = 0;
    int inside = 0;
    peri_solve_desc d;
    for (int32_t i = 0; i < n; ++i) {
        double depth = HUGE_VAL;
        for (int a = 0; a < dim; ++a) {
            depth = fmin(depth, fmin(x[i * dim + a], m->side - x[i * dim + a]));
            for (int e = 0; e < dim; ++e) want[i * dim + a] += strain[3 * a + e] * x[i * dim + e];
        }
        inside += depth >= s->ratio + LONGEST;
        if (depth < s->ratio + LONGEST)
            (void)MUST(b, peri_prescribe_displacement(b, peri_select_points(b, NULL, 1, &i), dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY,
                                                      &want[i * dim], NULL, NULL));
    }
    CHECK(inside > 5);
    peri_solve_desc_init(&d);
    d.tolerance = 1e-12;
    (void)MUST(b, peri_solve(b, &d, NULL));
    u = get(b, PERI_FIELD_DISPLACEMENT);
    for (int64_t k = 0; k < n * dim; ++k) worst = fmax(worst, fabs(u[k] - want[k]));
    free(x);
    free(u);
    free(want);
    peri_body_destroy(b);
    return worst / (1e-3 * s->ratio);
}

/* Partial cells and the equilibrium correction together. */
static void patches(int kind, int side, double horizon) {
    cell_mesh m = mesh_of(kind, side, 0.2, 3);
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        if (law == PERI_LAW_OTERKUS) continue; /* theta has a moment of its own */
        if (!test_long && m.dim == 3 && law != PERI_LAW_LPS) continue;
        solid s = solid_with(m.dim, law, PERI_QUADRATURE_PARTIAL, horizon);
        const double none = test_long || m.dim == 2 ? patch(&m, &s) : 1;
        s.correction = PERI_CORRECTION_EQUILIBRIUM;
        const double off = patch(&m, &s);
        printf("    %-14s %-14s error inside %.1e of strain x horizon, %.1e without correction\n", mesh_name[kind],
               law_name[law % 100], off, none);
        CHECK(off < 1e-8);
        CHECK(none > 1e-6);
    }
    mesh_free(&m);
}
static void patch_of_quadrilaterals(void) { patches(QUADS, 11, 2.6); }
static void patch_of_triangles(void) { patches(TRIANGLES, 9, 2.1); }
static void patch_of_hooks(void) { patches(HOOKS, 9, 2.3); }
static void patch_of_tetrahedra(void) { patches(TETRAHEDRA, 5, 1.2); }
static void patch_of_hexahedra(void) { patches(HEXAHEDRA, 8, 2.1); }

/* ---- a tensile specimen ------------------------------------------------------------------------------------------------ */

/* Half the width at x: 3 up to 6, then a smooth way to 4.5 at 10. */
static double half_width(double x) {
    const double t = fmax(0, fmin(1, (fabs(x) - 6) / 4));
    return 3 + 1.5 * t * t * (3 - 2 * t);
}

/* 28 x 6 x 4 hexahedra whose inner vertices are moved by up to a fifth of an edge; `fine` times as many per axis. */
static cell_mesh dogbone(int fine, uint64_t seed) {
    const int n[3] = {28 * fine, 6 * fine, 4 * fine};
    cell_mesh m;
    memset(&m, 0, sizeof m);
    m.kind = HEXAHEDRA;
    m.dim = 3;
    m.vertices = (int64_t)(n[0] + 1) * (n[1] + 1) * (n[2] + 1);
    m.x = (double *)malloc((size_t)m.vertices * 3 * sizeof *m.x);
    m.corner = (int32_t *)malloc((size_t)n[0] * (size_t)n[1] * (size_t)n[2] * 8 * sizeof *m.corner);
    m.offset = (int64_t *)calloc((size_t)n[0] * (size_t)n[1] * (size_t)n[2] + 1, sizeof *m.offset);
    for (int64_t v = 0; v < m.vertices; ++v) {
        const int64_t at[3] = {v % (n[0] + 1), v / (n[0] + 1) % (n[1] + 1), v / (n[0] + 1) / (n[1] + 1)};
        double *x = &m.x[3 * v], p[3];
        for (int e = 0; e < 3; ++e) {
            const double by = 0.2 * (2 * test_random(&seed) - 1);
            p[e] = (double)at[e] + (at[e] > 0 && at[e] < n[e] ? by : 0);
        }
        x[0] = p[0] / fine - 14;
        x[1] = (2 * p[1] / n[1] - 1) * half_width(x[0]);
        x[2] = p[2] / fine;
        if (at[0] == n[0] || at[1] == n[1] || at[2] == n[2]) continue;
        int32_t c[8];
        for (int k = 0; k < 8; ++k)
            c[k] = (int32_t)(v + (k % 4 == 1 || k % 4 == 2) + (k % 4 > 1 ? n[0] + 1 : 0) + (k > 3 ? (n[0] + 1) * (n[1] + 1) : 0));
        mesh_add(&m, 8, c);
    }
    return m;
}

/* E by the force of the grips and the strain of the waist, over that of the material; horizon in edges. */
static double modulus(int32_t law, int32_t correction, double ratio, int fine, uint64_t seed) {
    solid s = solid_with(3, law, PERI_QUADRATURE_PARTIAL, ratio / fine);
    cell_mesh m = dogbone(fine, seed);
    const double far_away[3] = {99, 99, 99}, pull[3] = {0.01, 0, 0}, zero[3] = {0, 0, 0};
    double lo[3] = {-99, -99, -99}, hi[3] = {-14 + 2 * s.ratio, 99, 99}, force[3], sum[5] = {0}, *x, *u;
    peri_solve_desc d;
    s.correction = correction;
    peri_body *b = mesh_body(&m, &s);
    (void)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), PERI_AXIS_XYZ, zero, NULL, NULL));
    lo[0] = -hi[0];
    const int32_t grip = (int32_t)MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, far_away)),
                                                                      PERI_AXIS_XYZ, pull, NULL, NULL));
    peri_solve_desc_init(&d);
    d.tolerance = 1e-8;
    (void)MUST(b, peri_solve(b, &d, NULL));
    (void)MUST(b, peri_get_reaction(b, grip, force));
    x = get(b, PERI_FIELD_POSITION);
    u = get(b, PERI_FIELD_DISPLACEMENT);
    for (int64_t i = 0; i < m.cells; ++i) { /* the line nearest to u(x) has the strain as its slope */
        if (fabs(x[3 * i]) > 4) continue;
        sum[0] += 1;
        sum[1] += x[3 * i];
        sum[2] += u[3 * i];
        sum[3] += x[3 * i] * x[3 * i];
        sum[4] += x[3 * i] * u[3 * i];
    }
    free(x);
    free(u);
    peri_body_destroy(b);
    mesh_free(&m);
    return fabs(force[0]) / (6 * 4) / ((sum[0] * sum[4] - sum[1] * sum[2]) / (sum[0] * sum[3] - sum[1] * sum[1])) / YOUNG;
}

static void a_dogbone_has_its_modulus(void) {
    for (int32_t law = test_long ? PERI_LAW_BOND_BASED : PERI_LAW_LPS; law < (test_long ? peri__end_law : PERI_LAW_LPS + 1); ++law)
        for (int k = 0; k < (test_long ? 4 : 1); ++k) {
            const double e = modulus(law, PERI_CORRECTION_MOMENT, k < 2 ? 2 + k : 2.5, 1, (uint64_t)k);
            printf("    %-14s horizon %.1f edges: E %.4f of the material's\n", law_name[law % 100], k < 2 ? 2.0 + k : 2.5, e);
            CHECK_NEAR(e, 1, 0.02, 0);
        }
}
static void a_fine_dogbone(void) {
    const double none = modulus(PERI_LAW_LPS, PERI_CORRECTION_NONE, 2, 1, 1), e = modulus(PERI_LAW_LPS, PERI_CORRECTION_MOMENT, 2, 2, 1);
    printf("    LPS, twice as fine: E %.4f of the material's; without correction, not so fine, %.4f\n", e, none);
    CHECK_NEAR(e, 1, 0.02, 0);
    CHECK(none > 1.1);
}

/* ---- what is refused ----------------------------------------------------------------------------------------------------- */

static const double places[12][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
                                     {0.5, 0, 0}, {2, 0, 0}, {0.2, 0.2, 0}, {0, 0, 0}};

/* A sound cell and one that is not: the status names it, and the body is as before. */
static void refuse(int dim, int corners, const int32_t *bad, int32_t status, const char *field) {
    const solid s = solid_with(dim, PERI_LAW_BOND_BASED, PERI_QUADRATURE_PARTIAL, 2);
    int32_t order[40] = {0, 1, 2, 3, 4, 5, 6, 7};
    const int64_t first = dim == 3 ? 8 : 4, offset[3] = {0, first, first + corners};
    peri_cells_desc d;
    peri_error error;
    peri_body *b = solid_new(&s);
    memcpy(&order[first], bad, (size_t)corners * sizeof *bad);
    peri_cells_desc_init(&d);
    d.vertex_count = 12, d.vertices = places[0], d.vertex_stride = 3, d.cell_count = 1, d.corners = order, d.offsets = offset;
    (void)MUST(b, peri_add_cells(b, &d));
    d.cell_count = 2;
    CHECK(peri_add_cells(b, &d) == status);
    (void)MUST(b, peri_get_error(b, &error));
    CHECK(error.index == 1 && strcmp(error.field, field) == 0);
    if (error.index != 1) printf("    corners %d %d %d %d\n", bad[0], bad[1], bad[2], corners);
    CHECK(peri_point_count(b) == 1);
    peri_body_destroy(b);
}

static void bad_cells(void) {
    const int32_t crossed[4] = {0, 1, 3, 2}, line[3] = {0, 8, 9}, spike[4] = {0, 9, 1, 3}, touch[5] = {0, 1, 2, 8, 3};
    const int32_t beyond[4] = {0, 1, 2, 12}, negative[4] = {0, 1, 2, -1}, flat[4] = {0, 1, 2, 3}, two[2] = {0, 1}, twice[4] = {0, 1, 1, 0};
    const int32_t seven[7] = {0, 1, 2, 3, 4, 5, 6}, back[4] = {8, 1, 0, 3};
    const int32_t turned[8] = {0, 1, 2, 3, 4, 7, 6, 5}, inverted[8] = {0, 1, 2, 3, 6, 7, 4, 5}, pierced[8] = {0, 1, 2, 3, 4, 5, 10, 7};
    const int32_t twisted[6] = {0, 1, 2, 4, 6, 5}, sound[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    refuse(2, 4, crossed, PERI_ERROR_POINT, "corners");
    refuse(2, 3, line, PERI_ERROR_POINT, "corners");
    refuse(2, 4, spike, PERI_ERROR_POINT, "corners");
    refuse(2, 4, back, PERI_ERROR_POINT, "corners"); /* 1 to 0 over 8 */
    refuse(2, 5, touch, PERI_ERROR_POINT, "corners"); /* vertex 8 lies on the side 0-1 */
    refuse(2, 4, twice, PERI_ERROR_POINT, "corners");
    refuse(2, 4, beyond, PERI_ERROR_INDEX, "corners");
    refuse(2, 4, negative, PERI_ERROR_INDEX, "corners");
    refuse(2, 2, two, PERI_ERROR_RANGE, "offsets");
    refuse(3, 4, flat, PERI_ERROR_POINT, "corners");
    refuse(3, 8, turned, PERI_ERROR_POINT, "corners"); /* the upper face the other way round, and turned by a half */
    refuse(3, 8, inverted, PERI_ERROR_POINT, "corners");
    refuse(3, 8, pierced, PERI_ERROR_POINT, "corners"); /* a corner beyond the opposite face */
    refuse(3, 6, twisted, PERI_ERROR_POINT, "corners");
    refuse(3, 7, seven, PERI_ERROR_RANGE, "offsets");
    refuse(3, 3, sound, PERI_ERROR_RANGE, "offsets");
    refuse(3, 4, beyond, PERI_ERROR_INDEX, "corners");
}

/* Corners that are one are a triangle of four corners, and a wedge of eight. */
static void corners_may_be_one(void) {
    const int32_t triangle[4] = {0, 1, 2, 2}, wedge[8] = {0, 1, 2, 2, 4, 5, 6, 6};
    for (int dim = 2; dim <= 3; ++dim) {
        const solid s = solid_with(dim, PERI_LAW_BOND_BASED, PERI_QUADRATURE_PARTIAL, 2);
        const int32_t sound[8] = {0, 1, 2, 3, 4, 5, 6, 7};
        int32_t order[16];
        peri_cells_desc d;
        double v[2];
        peri_body *b = solid_new(&s);
        peri_cells_desc_init(&d);
        d.vertex_count = 12, d.vertices = places[0], d.vertex_stride = 3, d.cell_count = 2, d.corners = order;
        d.cell_corners = dim == 3 ? 8 : 4;
        memcpy(order, sound, sizeof sound);
        memcpy(&order[d.cell_corners], dim == 3 ? wedge : triangle, (size_t)d.cell_corners * sizeof *order);
        (void)MUST(b, peri_add_cells(b, &d));
        (void)MUST(b, peri_build(b));
        (void)MUST(b, peri_get_field(b, PERI_FIELD_VOLUME, v, 2));
        CHECK_NEAR(v[0], 1, 1e-14, 0);
        CHECK_NEAR(v[1], 0.5, 1e-14, 0);
        peri_body_destroy(b);
    }
}

/* ---- memory, clones, saved states ----------------------------------------------------------------------------------------- */

/* Each allocation fails once: it is told, nothing is lost, and the same call works after that. */
static void memory_may_be_short(void) {
    cell_mesh m = mesh_of(TRIANGLES, 5, 0.2, 3);
    const peri_cells_desc c = mesh_desc(&m);
    const solid s = solid_with(2, PERI_LAW_LPS, PERI_QUADRATURE_PARTIAL, 1.5);
    specimen p = solid_specimen(&s, 1, 1, 1);
    pool memory = {0, 0, 0, 0, -1, 0};
    int failures = 0;
    hook(&p.desc, &memory);
    for (int done = 0; !done; ++failures) {
        peri_body *b = specimen_start(&p);
        const int32_t last = m.corner[m.total - 1];
        m.corner[m.total - 1] = -1; /* what was taken for cells of which one is refused is given back */
        CHECK(peri_add_cells(b, &c) == PERI_ERROR_INDEX);
        m.corner[m.total - 1] = last;
        memory.fail_at = memory.calls + failures;
        int64_t status = peri_add_cells(b, &c);
        CHECK(status == m.cells || (status == PERI_ERROR_MEMORY && peri_point_count(b) == 0));
        if (status < 0) {
            memory.fail_at = -1;
            (void)MUST(b, peri_add_cells(b, &c));
        }
        const int32_t built = peri_build(b);
        CHECK(built == PERI_OK || built == PERI_ERROR_MEMORY);
        done = status > 0 && built == PERI_OK;
        memory.fail_at = -1;
        if (built < 0) (void)MUST(b, peri_build(b));
        peri_body_destroy(b);
        CHECK(memory.blocks == 0 && memory.bytes == 0 && memory.wrong == 0);
    }
    CHECK(failures > 20);
    mesh_free(&m);
}

/* Cells are kept until peri_build where the quadrature asks for them, and then they are gone. */
static void cells_go_with_the_build(void) {
    for (int q = 0; q < 2; ++q) {
        cell_mesh m = mesh_of(HEXAHEDRA, 4, 0.2, 3);
        const peri_cells_desc c = mesh_desc(&m);
        const solid s = solid_with(3, PERI_LAW_LPS, q ? PERI_QUADRATURE_PARTIAL : PERI_QUADRATURE_FULL, 1.5);
        peri_body *a = solid_new(&s), *b = solid_new(&s);
        peri_memory one, other;
        double *x, *v;
        (void)MUST(a, peri_add_cells(a, &c));
        (void)MUST(a, peri_get_memory(a, &one));
        const double bytes = (double)one.total;
        (void)MUST(a, peri_build(a));
        x = get(a, PERI_FIELD_POSITION);
        v = get(a, PERI_FIELD_VOLUME);
        (void)MUST(b, peri_add_points(b, m.cells, x, v, NULL));
        (void)MUST(b, peri_get_memory(b, &other));
        CHECK(q ? bytes - (double)other.total >= (double)m.cells * 8 * 24 : bytes == (double)other.total);
        (void)MUST(b, peri_build(b));
        (void)MUST(a, peri_get_memory(a, &one));
        (void)MUST(b, peri_get_memory(b, &other));
        CHECK(one.points == other.points && one.state == other.state);
        free(x);
        free(v);
        peri_body_destroy(a);
        peri_body_destroy(b);
        mesh_free(&m);
    }
}

static void shake(peri_body *b) {
    uint64_t seed = 11;
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    for (int64_t k = 0; k < peri_point_count(b) * peri_dimension(b); ++k) u[k] = 1e-3 * (2 * test_random(&seed) - 1);
    put(b, PERI_FIELD_DISPLACEMENT, u);
    free(u);
}

static void same_bits(peri_body *a, peri_body *b) {
    const int64_t n = peri_point_count(a) * peri_dimension(a);
    double *f = get(a, PERI_FIELD_FORCE_DENSITY), *g = get(b, PERI_FIELD_FORCE_DENSITY);
    CHECK(n == peri_point_count(b) * peri_dimension(b) && memcmp(f, g, (size_t)n * sizeof *f) == 0);
    free(f);
    free(g);
}

/* Clones share the weights, reset keeps them, and a state goes to a body of the same cells, not to one of points with their volumes. */
static void clones_and_states(void) {
    cell_mesh m = mesh_of(QUADS, 6, 0.2, 3);
    const solid s = solid_with(2, PERI_LAW_LPS, PERI_QUADRATURE_PARTIAL, 1.7);
    peri_body *a = mesh_body(&m, &s), *twin = mesh_body(&m, &s), *points = solid_new(&s), *copy;
    double *x = get(a, PERI_FIELD_POSITION), *v = get(a, PERI_FIELD_VOLUME);
    peri_error error;
    shake(a);
    (void)MUST(a, peri_body_clone(a, &copy, NULL));
    same_bits(a, copy);
    (void)MUST(a, peri_save_state(a, "build/test_cell_bodies.state"));
    (void)MUST(twin, peri_load_state(twin, "build/test_cell_bodies.state"));
    same_bits(a, twin);
    (void)MUST(points, peri_add_points(points, m.cells, x, v, NULL));
    (void)MUST(points, peri_build(points));
    CHECK(peri_load_state(points, "build/test_cell_bodies.state") == PERI_ERROR_STATE);
    CHECK(peri_get_error(points, &error) == PERI_OK && strcmp(error.field, "families") == 0);
    (void)MUST(a, peri_reset(a));
    shake(a);
    same_bits(a, copy);
    (void)remove("build/test_cell_bodies.state");
    free(x);
    free(v);
    peri_body_destroy(a);
    peri_body_destroy(twin);
    peri_body_destroy(points);
    peri_body_destroy(copy);
    mesh_free(&m);
}

/* Materials by cell, beside a box; and the same bits from four threads. */
static void materials_and_threads(void) {
    cell_mesh m = mesh_of(TRIANGLES, 12, 0.2, 3);
    const solid s = solid_with(2, PERI_LAW_LPS, PERI_QUADRATURE_PARTIAL, 3);
    const double lo[2] = {12, 0}, hi[2] = {20, 12};
    peri_body *body[2];
    for (int k = 0; k < 2; ++k) {
        specimen p = solid_specimen(&s, 1, 1, 1);
        peri_material_desc soft = p.material;
        peri_cells_desc d = mesh_desc(&m);
        int32_t *material = (int32_t *)malloc((size_t)m.cells * sizeof *material);
        double *of;
        p.desc.threads = k ? 4 : 1;
        peri_body *b = body[k] = specimen_start(&p);
        soft.young = 0.5;
        const int32_t second = (int32_t)MUST(b, peri_add_material(b, &soft));
        for (int64_t c = 0; c < m.cells; ++c) material[c] = c % 3 ? second : peri_id(b, PERI_KIND_MATERIAL, 1);
        CHECK(peri_add_cells(b, &d) == PERI_ERROR_ID_NONE);
        d.materials = material;
        (void)MUST(b, peri_add_box(b, second, lo, hi, 1));
        (void)MUST(b, peri_add_cells(b, &d));
        (void)MUST(b, peri_build(b));
        of = get(b, PERI_FIELD_MATERIAL);
        for (int64_t c = 0; c < m.cells; ++c) CHECK((int32_t)of[96 + c] == PERI_ID_INDEX(material[c]));
        shake(b);
        free(of);
        free(material);
    }
    same_bits(body[0], body[1]);
    peri_body_destroy(body[0]);
    peri_body_destroy(body[1]);
    mesh_free(&m);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(patch_of_quadrilaterals);
    RUN(patch_of_triangles);
    RUN(patch_of_hooks);
    RUN(patch_of_tetrahedra);
    LONG_RUN(patch_of_hexahedra);
    RUN(a_dogbone_has_its_modulus);
    LONG_RUN(a_fine_dogbone);
    RUN(bad_cells);
    RUN(corners_may_be_one);
    RUN(memory_may_be_short);
    RUN(cells_go_with_the_build);
    RUN(clones_and_states);
    RUN(materials_and_threads);
    return test_end("test_cell_bodies");
}
