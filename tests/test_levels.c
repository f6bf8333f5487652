/* SPDX-License-Identifier: MIT */
/* test_levels.c - coarse levels that open cracks as the points do.

   SOURCE OF TRUTH: the equilibrium, which no preconditioner changes: the solution by the blocks of the diagonal alone; parts that no bond
   joins do not act on each other; and the bounds that the levels were made for: 40 iterations to 1e-8 for plates and blocks with 3, 9 and
   27 cracks, 12 passes over the bonds per bond that breaks one by one. Parts thinner than the horizon, side by side, are what the levels
   serve least: at most four times the iterations of the blocks. */
#include "scene.h"

static uint32_t state;
static double random_share(void) {
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) / 16777216.0;
}

/* Cracks of random direction, a grid of them over the unit square; in 3D slits of 0.8 along z. */
static void crack(peri_body *b, int dim, int cracks) {
    const int side = (int)ceil(sqrt((double)cracks) - 1e-9);
    int k;
    state = 7;
    for (k = 0; k < cracks; ++k) {
        const double x = 0.05 + 0.9 * (k % side + 0.5) / side, y = 0.05 + 0.9 * (k / side + 0.5) / side;
        const double a = PI * random_share(), half = 0.35 / side;
        const double from[3] = {x - half * cos(a), y - half * sin(a), 0.1}, to[3] = {x + half * cos(a), y + half * sin(a), 0};
        const double along[3] = {2 * half * cos(a), 2 * half * sin(a), 0}, up[3] = {0, 0, 0.8};
        if (dim == 2) MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
        else MUST(b, peri_cut_rectangle(b, PERI_CUT_INITIAL, from, along, up));
    }
}

static void hold(peri_body *b, int axis, double from, double to, double way) {
    double lo[3] = {-9, -9, -9}, hi[3] = {9, 9, 9}, value[3] = {0, 0, 0};
    lo[axis] = from;
    hi[axis] = to;
    value[axis] = way;
    const int32_t set = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    MUST(b, peri_prescribe_displacement(b, set, all_axes(peri_dimension(b)), value, NULL, NULL));
}

static peri_body *unit_body(int32_t space, int32_t law, int n, double poisson) {
    specimen s = specimen_of(space, law, poisson, 1.0 / n, 3, n, n, n);
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    return specimen_make(&s);
}

static int64_t solve(peri_body *b, int32_t preconditioner) {
    peri_solve_desc d;
    peri_solve_report r;
    peri_solve_desc_init(&d);
    d.fracture = 0;
    d.preconditioner = preconditioner;
    d.tolerance = 1e-8;
    memset(&r, 0, sizeof r);
    MUST(b, peri_solve(b, &d, &r));
    CHECK(r.residual <= 1e-8);
    return r.iterations;
}

/* Largest difference of the displacements of two bodies, over the largest displacement. */
static double apart(peri_body *a, peri_body *b) {
    const int64_t n = peri_point_count(a) * peri_dimension(a);
    double *u = (double *)malloc((size_t)n * sizeof *u), *v = (double *)malloc((size_t)n * sizeof *v), most = 0, size = 0;
    int64_t k;
    MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, u, n));
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, v, n));
    for (k = 0; k < n; ++k) {
        most = fmax(most, fabs(u[k] - v[k]));
        size = fmax(size, fabs(v[k]));
    }
    free(u);
    free(v);
    return most / size;
}

static int64_t cracked(int32_t space, int32_t law, int n, int cracks, int compare) {
    peri_body *b = unit_body(space, law, n, 0.3), *other = NULL;
    crack(b, dim_of(space), cracks);
    hold(b, 0, -1, 3.0 / n, 0);
    hold(b, 0, 1 - 3.0 / n, 2, 1e-3);
    if (compare) MUST(b, peri_body_clone(b, &other, NULL));
    const int64_t iterations = solve(b, PERI_PRECONDITIONER_MULTILEVEL);
    if (compare) {
        (void)solve(other, PERI_PRECONDITIONER_BLOCK_JACOBI);
        CHECK(apart(b, other) < 1e-5); /* residuals of 1e-8, and a condition of some hundreds */
    }
    printf("    %s, %s, %d points a side, %d cracks: %d iterations\n", space_name[space % 100], law_name[law % 100], n, cracks,
           (int)iterations);
    peri_body_destroy(other);
    peri_body_destroy(b);
    return iterations;
}

static void cracks_cost_little(void) {
    static const int32_t laws[3] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_CORRESPONDENCE};
    int k;
    for (k = 0; k < 3; ++k) CHECK(cracked(PERI_SPACE_PLANE_STRESS, laws[k], 60, 9, 1) <= 40);
    CHECK(cracked(PERI_SPACE_SOLID, PERI_LAW_LPS, 15, 3, 1) <= 40);
    if (!test_long) return;
    for (k = 3; k <= 27; k *= 3) CHECK(cracked(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 400, k, 0) <= 40);
    for (k = 3; k <= 27; k *= 3) CHECK(cracked(PERI_SPACE_SOLID, PERI_LAW_LPS, 48, k, 0) <= 40);
}

/* What docs/statics.md says of plates of 200^2 points. */
static int64_t chessboard(int n, double ratio) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1.0 / n, 3, n, n, n);
    double *x = (double *)malloc((size_t)(2 * n * n) * sizeof *x), *v = (double *)malloc((size_t)(n * n) * sizeof *v);
    int32_t *id = (int32_t *)malloc((size_t)(n * n) * sizeof *id), material[2];
    int k;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_start(&s);
    material[0] = peri_id(b, PERI_KIND_MATERIAL, 1);
    s.material.young *= ratio;
    material[1] = (int32_t)MUST(b, peri_add_material(b, &s.material));
    for (k = 0; k < n * n; ++k) {
        x[2 * k] = (k % n + 0.5) / n;
        x[2 * k + 1] = (k / n + 0.5) / n;
        v[k] = 1.0 / n / n;
        id[k] = material[((int)(8 * x[2 * k]) + (int)(8 * x[2 * k + 1])) % 2];
    }
    MUST(b, peri_add_points(b, n * n, x, v, id));
    MUST(b, peri_build(b));
    free(x);
    free(v);
    free(id);
    hold(b, 0, -1, 3.0 / n, 0);
    hold(b, 0, 1 - 3.0 / n, 2, 1e-3);
    const int64_t iterations = solve(b, PERI_PRECONDITIONER_MULTILEVEL);
    printf("    chessboard 1 : %g: %d iterations\n", ratio, (int)iterations);
    peri_body_destroy(b);
    return iterations;
}

static int64_t plane_strain(int n, double poisson) {
    peri_body *b = unit_body(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, n, poisson);
    hold(b, 0, -1, 3.0 / n, 0);
    hold(b, 0, 1 - 3.0 / n, 2, 1e-3);
    const int64_t iterations = solve(b, PERI_PRECONDITIONER_MULTILEVEL);
    printf("    Poisson's ratio %g: %d iterations\n", poisson, (int)iterations);
    peri_body_destroy(b);
    return iterations;
}

static void table_of_plates(void) {
    static const int cracks[4] = {0, 3, 9, 27}, told[4] = {21, 35, 38, 39}, strain[3] = {69, 280, 928};
    static const double ratio[3] = {0.49, 0.499, 0.4999};
    int k;
    if (!test_long) {
        CHECK(chessboard(60, 1e3) <= 76 && plane_strain(60, 0.49) <= 76);
        return;
    }
    for (k = 0; k < 4; ++k) CHECK(10 * cracked(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 200, cracks[k], 0) <= 11 * told[k]);
    for (k = 3; k <= 9; k += 3) CHECK(chessboard(200, pow(10, k)) <= 76);
    for (k = 0; k < 3; ++k) CHECK(10 * plane_strain(200, ratio[k]) <= 11 * strain[k]);
}

/* Bonds from one strip, or column, of two cells' width to the next. */
static int32_t between_columns(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const int n = *(const int *)user;
    (void)i;
    (void)j;
    return (int)(xi[0] * n / 2) != (int)(xj[0] * n / 2) || (int)(xi[1] * n / 2) != (int)(xj[1] * n / 2);
}

static int32_t between_strips(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    const int n = *(const int *)user;
    (void)i;
    (void)j;
    return (int)(xi[0] * n / 2) != (int)(xj[0] * n / 2);
}

/* A plate that is cut into strips along its pull, each of two rows of points: many nodes at a site, on every level. */
static void strips_side_by_side(void) {
    int n = 60;
    peri_body *b = unit_body(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, n, 0.3), *other = NULL;
    MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, between_strips, &n));
    hold(b, 1, -1, 3.0 / n, 0);
    hold(b, 1, 1 - 3.0 / n, 2, 1e-3);
    MUST(b, peri_body_clone(b, &other, NULL));
    const int64_t levels = solve(b, PERI_PRECONDITIONER_MULTILEVEL), blocks = solve(other, PERI_PRECONDITIONER_BLOCK_JACOBI);
    printf("    30 strips: %d iterations, %d by blocks\n", (int)levels, (int)blocks);
    CHECK(levels <= 4 * blocks && apart(b, other) < 1e-5);
    peri_body_destroy(other);
    peri_body_destroy(b);
}

/* 196 columns: more nodes on the coarsest level than are solved directly. */
static void columns_side_by_side(void) {
    specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1.0 / 28, 3, 28, 28, 12);
    int n = 28;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    peri_body *b = specimen_make(&s), *other = NULL;
    MUST(b, peri_cut_if(b, PERI_CUT_INITIAL, between_columns, &n));
    hold(b, 2, -1, 2.0 / n, 0);
    hold(b, 2, 10.0 / n, 2, 1e-3);
    MUST(b, peri_body_clone(b, &other, NULL));
    const int64_t levels = solve(b, PERI_PRECONDITIONER_MULTILEVEL), blocks = solve(other, PERI_PRECONDITIONER_BLOCK_JACOBI);
    printf("    196 columns: %d iterations, %d by blocks\n", (int)levels, (int)blocks);
    CHECK(levels <= 4 * blocks && apart(b, other) < 1e-5);
    peri_body_destroy(other);
    peri_body_destroy(b);
}

/* A plate cut in two, both halves held at their outer ends, one pushed: as the half alone; the other stays. */
static void halves_do_not_meet(void) {
    const double cut[2][2] = {{0.5, -1}, {0.5, 2}}, lo[2] = {0, 0}, hi[2] = {0.5, 1}, push[2] = {1e-4, 3e-4};
    const double left[2] = {-1, -1}, middle[2] = {0.4999, 2};
    double *u, *v, most = 0, size = 0, still = 0;
    int64_t k, count, found = 0;
    const int n = 40;
    peri_body *b = unit_body(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, n, 0.3), *half;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.3, 1.0 / n, 3, n, n, n);
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    half = specimen_start(&s);
    MUST(half, peri_add_box(half, peri_id(half, PERI_KIND_MATERIAL, 1), lo, hi, s.spacing));
    MUST(half, peri_build(half));
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, cut[0], cut[1]));
    hold(b, 0, -1, 3.0 / n, 0);
    hold(b, 0, 1 - 3.0 / n, 2, 0);
    hold(half, 0, -1, 3.0 / n, 0);
    MUST(b, peri_apply_body_force(b, (int32_t)MUST(b, peri_select_box(b, NULL, left, middle)), push, NULL, NULL));
    MUST(half, peri_apply_body_force(half, PERI_ALL, push, NULL, NULL));
    CHECK(solve(b, PERI_PRECONDITIONER_MULTILEVEL) <= 40);
    CHECK(solve(half, PERI_PRECONDITIONER_MULTILEVEL) <= 40);
    count = peri_point_count(b);
    u = (double *)malloc((size_t)(2 * count) * sizeof *u);
    v = (double *)malloc((size_t)count * sizeof *v);
    MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * count));
    MUST(half, peri_get_field(half, PERI_FIELD_DISPLACEMENT, v, count)); /* half as many points, two components */
    for (k = 0; k < count; ++k) {
        if (k % n >= n / 2) {
            still = fmax(still, fabs(u[2 * k]) + fabs(u[2 * k + 1]));
            continue;
        }
        most = fmax(most, fmax(fabs(u[2 * k] - v[2 * found]), fabs(u[2 * k + 1] - v[2 * found + 1])));
        size = fmax(size, fabs(v[2 * found + 1]));
        found++;
    }
    CHECK(2 * found == count && size > 0 && most < 1e-6 * size && still < 1e-9 * size);
    free(u);
    free(v);
    peri_body_destroy(half);
    peri_body_destroy(b);
}

/* An edge crack that grows bond by bond; `breaks` rounds of that. */
static double passes_per_bond(int n, int64_t breaks) {
    const double from[2] = {-0.1, 0.5}, to[2] = {0.4, 0.5};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.25, 1.0 / n, 3, n, n, n);
    peri_solve_desc d;
    peri_solve_report r;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.fracture_energy = 1e-6;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, from, to));
    hold(b, 1, -1, 3.0 / n, 0);
    hold(b, 1, 1 - 3.0 / n, 2, 0.004);
    peri_solve_desc_init(&d);
    d.criticality = 1;
    d.breaks = breaks;
    memset(&r, 0, sizeof r);
    CHECK(peri_solve(b, &d, &r) == PERI_ERROR_CONVERGENCE && r.broken >= breaks);
    printf("    %d points a side: %.1f passes a round, %.1f a bond, %d bonds\n", n, (double)r.passes / (double)breaks,
           (double)r.passes / (double)r.broken, (int)r.broken);
    peri_body_destroy(b);
    return (double)r.passes / (double)r.broken;
}

static void breaks_one_by_one(void) {
    CHECK(passes_per_bond(40, 60) <= 12);
    if (test_long) CHECK(passes_per_bond(100, 550) <= 12);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(cracks_cost_little);
    RUN(table_of_plates);
    RUN(strips_side_by_side);
    RUN(columns_side_by_side);
    RUN(halves_do_not_meet);
    RUN(breaks_one_by_one);
    return test_end("test_levels");
}
