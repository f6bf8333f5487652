/* SPDX-License-Identifier: MIT */
/* test_survivors_choice.c - what `make mutants` found that no other test of choices, families, steps and pairs of materials looked at.

   SOURCE OF TRUTH: peri.h; the best within a budget leaves nothing better within it; kernels differ in speed alone; areas of circular
   segments; uniform strain. */
#include "refusal.h"

/* ---- choices -------------------------------------------------------------------------------------------------------- */

/* What peri_choose says of a square of 1 (a cube), the feature as large, LPS where nu is not that of bonds. */
static int32_t choose(int32_t space, int32_t quantity, double error, int64_t bytes, peri_choose_report *r, peri_error *e) {
    peri_body_desc d;
    peri_material_desc m;
    peri_choose_desc g;
    peri_body_desc_init(&d);
    d.space = space;
    peri_material_desc_init(&m, PERI_LAW_LPS);
    m.young = 1;
    m.poisson = space == PERI_SPACE_PLANE_STRESS ? 1.0 / 3 : 0.25;
    m.density = 1;
    peri_choose_desc_init(&g);
    g.quantity = quantity;
    g.error = error;
    g.bytes = bytes;
    g.feature = 1;
    for (int k = 0; k < 3; ++k) g.hi[k] = 1;
    memset(r, 0, sizeof *r);
    return peri_choose(&g, &d, &m, r, e);
}

/* Within a budget the best is that of the least error: what is asked to be better by a tenth takes more than the budget. */
static void nothing_within_the_budget_is_better(void) {
    static const int64_t budget[3] = {400000, 1000000, 3000000};
    for (int32_t quantity = PERI_QUANTITY_DEFORMATION; quantity <= PERI_QUANTITY_WAVES; ++quantity)
        for (int k = 0; k < 3; ++k) {
            peri_choose_report best, better;
            if (choose(PERI_SPACE_PLANE_STRESS, quantity, 0, budget[k], &best, NULL) != PERI_OK) continue;
            CHECK(best.cost.peak <= budget[k] && best.error > 0);
            if (choose(PERI_SPACE_PLANE_STRESS, quantity, 0.9 * best.error, 0, &better, NULL) == PERI_OK) {
                CHECK(better.error <= 0.9 * best.error);
                CHECK(better.cost.peak > budget[k]);
            }
        }
}

/* ---- families of the caller ----------------------------------------------------------------------------------------- */

/* The first entry that is no point is named, be it the number of points itself. */
static void the_first_wrong_entry_is_named(void) {
    const double x[8] = {0, 0, 1, 0, 2, 0, 3, 0}, volume[4] = {1, 1, 1, 1};
    const int32_t rows[8] = {1, 4, 0, 1, 3, -1, 2, 3};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.5, 1, 1, 1);
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, 4, x, volume, NULL));
    MUST(b, peri_set_families(b, 2, rows));
    REFUSE(b, PERI_ERROR_IBOND, peri_build(b));
    FIELD_IS("ibond");
    CHECK(seen.index == 1 && seen.value == 4);
    peri_body_destroy(b);
}

/* ---- shapes of families --------------------------------------------------------------------------------------------- */

static int remarks;
static void count_remarks(void *user, int32_t level, const char *text) {
    (void)user, (void)text;
    remarks += level > 0;
}

/* A row whose points stand a to the left and to the right by turns, two families long to each side: the mean square across it is half of
   a^2 (two nearest at a, two next at 0), that of the way to the nearest 1 + a^2. Flat is what has less than 0.4^2 of that (span.c). */
static int is_flat(double a) {
    double x[40], volume[20];
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 2.2, 1, 1, 1);
    for (int k = 0; k < 20; ++k) x[2 * k] = k, x[2 * k + 1] = k % 2 ? a : 0, volume[k] = 1;
    s.desc.log = count_remarks;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_points(b, 20, x, volume, NULL));
    remarks = 0;
    MUST(b, peri_build(b));
    peri_body_destroy(b);
    return remarks;
}
static void rows_that_zigzag(void) {
    CHECK(is_flat(0.5) == 1); /* 0.1 */
    CHECK(is_flat(0.6) == 1); /* 0.13 */
    CHECK(is_flat(1.2) == 0); /* 0.3 */
}

/* A step that is too large is refused, and where it is forced remarked: one or the other. */
static void steps_are_refused_or_remarked(void) {
    for (int32_t forced = 0; forced < 2; ++forced) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.2, 6, 5, 1);
        peri_advance_desc r;
        s.desc.log = count_remarks;
        peri_body *b = specimen_make(&s);
        peri_advance_desc_init(&r);
        r.steps = 1;
        r.time_step = 1.1 * peri_stable_step(b);
        r.force_step = forced;
        remarks = 0;
        if (forced) MUST(b, peri_advance(b, &r));
        else REFUSE(b, PERI_ERROR_STEP, peri_advance(b, &r));
        CHECK(remarks == forced);
        peri_body_destroy(b);
    }
}

/* The circle of radius 5 about one cell passes a corner of the other, (-3, 4), from where a side of it goes on through the circle to
   (5, 4): inside is the segment above y = 4, 25 acos(4/5) - 12 of 16. The other way the circle, sqrt(26) away, misses the cell. */
static void corners_on_the_horizon(void) {
    const double vertex[16] = {-0.05, -0.05, 0.05, -0.05, 0.05, 0.05, -0.05, 0.05, -3, 4, 5, 4, 5, 6, -3, 6};
    const int32_t corners[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const double u[4] = {0, 0, 1e-3, 5e-3}; /* along the bond: a stretch of 1e-3 */
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 5, 1, 1, 1);
    peri_cells_desc cells;
    double c;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
    peri_body *b = specimen_start(&s);
    const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
    peri_cells_desc_init(&cells);
    cells.vertex_count = 8;
    cells.vertices = vertex;
    cells.cell_count = 2;
    cells.corners = corners;
    cells.cell_corners = 4;
    MUST(b, peri_add_cells(b, &cells));
    MUST(b, peri_build(b));
    MUST(b, peri_get_bond_constants(b, m, m, &c, NULL));
    put(b, PERI_FIELD_DISPLACEMENT, u);
    double *f = get(b, PERI_FIELD_FORCE_DENSITY);
    const double expected = c * 1e-3 * 0.5 * (25 * acos(0.8) - 12) / sqrt(26);
    CHECK_NEAR(f[0], expected, 1e-9, 0);
    CHECK_NEAR(f[1], 5 * expected, 1e-9, 0);
    free(f);
    peri_body_destroy(b);
}

/* ---- materials and what is between them ----------------------------------------------------------------------------- */

/* Two blocks side by side, along x; a: the left one's. rows: families of the caller, or NULL. */
static peri_body *blocks(const peri_material_desc *a, const peri_material_desc *c, const peri_material_desc *face, int32_t width,
                         const int32_t *rows) {
    const double lo[2] = {0, 0}, mid[2] = {5, 4}, mid0[2] = {5, 0}, hi[2] = {10, 4};
    peri_body_desc d;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 2.2;
    d.threads = 1;
    d.geometry = PERI_GEOMETRY_LINEAR;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    const int32_t i = (int32_t)MUST(b, peri_add_material(b, a)), j = (int32_t)MUST(b, peri_add_material(b, c));
    if (face) MUST(b, peri_set_interface(b, i, j, face));
    MUST(b, peri_add_box(b, i, lo, mid, 1));
    MUST(b, peri_add_box(b, j, mid0, hi, 1));
    if (rows) MUST(b, peri_set_families(b, width, rows));
    MUST(b, peri_build(b));
    return b;
}

static peri_material_desc material_of(int32_t law, double young) {
    peri_material_desc m;
    peri_material_desc_init(&m, law);
    m.young = young;
    if (law != PERI_LAW_BOND_BASED) m.poisson = 0.25;
    m.density = 1;
    return m;
}

/* "the ends are as stiff as they are": where not both are bond-based an interface has a strength alone. */
static void strength_between_laws_leaves_the_stiffness(void) {
    for (int swap = 0; swap < 2; ++swap) {
        const peri_material_desc one = material_of(PERI_LAW_BOND_BASED, 1), two = material_of(PERI_LAW_LPS, 3);
        peri_material_desc face = two;
        double *f[2], *u = random_field(80, 1e-3, 5);
        face.critical_stretch = 0.5;
        for (int k = 0; k < 2; ++k) {
            peri_body *b = blocks(swap ? &two : &one, swap ? &one : &two, k ? &face : NULL, 0, NULL);
            put(b, PERI_FIELD_DISPLACEMENT, u);
            f[k] = get(b, PERI_FIELD_FORCE_DENSITY);
            peri_body_destroy(b);
        }
        for (int k = 0; k < 80; ++k) CHECK_NEAR(f[1][k], f[0][k], 1e-12, 1e-15);
        free(f[0]);
        free(f[1]);
        free(u);
    }
}

/* The step is bounded by the stiffest row, which may lie at a stiff interface; "weights are computed as for found families": so is that. */
static void stiff_interfaces_bound_the_step(void) {
    const peri_material_desc one = material_of(PERI_LAW_BOND_BASED, 1), two = material_of(PERI_LAW_BOND_BASED, 2);
    const peri_material_desc face = material_of(PERI_LAW_BOND_BASED, 50);
    peri_body *found = blocks(&one, &two, &face, 0, NULL);
    const int32_t width = peri_family_width(found);
    int32_t *rows = (int32_t *)malloc(40 * (size_t)width * sizeof *rows);
    MUST(found, peri_get_families(found, 0, 40, rows, 40 * width));
    peri_body *given = blocks(&one, &two, &face, width, rows);
    CHECK_NEAR(peri_stable_step(found), peri_stable_step(given), 1e-12, 0);
    free(rows);
    peri_body_destroy(found);
    peri_body_destroy(given);
}

static int32_t strain_all(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    const double *x = (const double *)user;
    for (int64_t k = 0; k < count; ++k) {
        value[2 * k] = 0.01 * factor * x[2 * points[k]];
        value[2 * k + 1] = -0.01 * x[2 * points[k] + 1];
    }
    return 0;
}

/* Confined stretch with one limit and two compressions, y pressed by a limit: what goes with equal limits is that which breaks first.
   Of 9 bonds along x of each of 4 rows (nearest) and 8 (second) those across are 1 and 2, those within each block 4 and 3. */
static void of_equal_limits_the_lower_compression_counts(void) {
    for (int swap = 0; swap < 2; ++swap) {
        peri_material_desc one = material_of(PERI_LAW_BOND_BASED, 1), two = one;
        peri_solve_desc st;
        one.criterion = two.criterion = PERI_CRITERION_CONFINED_STRETCH;
        one.critical_stretch = two.critical_stretch = 0.01;
        one.compression = swap ? 0.5 : 0.25;
        two.compression = swap ? 0.25 : 0.5;
        peri_body *b = blocks(&one, &two, NULL, 0, NULL);
        double *x = get(b, PERI_FIELD_POSITION);
        MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, strain_all, x));
        peri_solve_desc_init(&st);
        st.load_from = 1.4; /* 0.014 beside 0.01 (1 + 0.25) and 0.01 (1 + 0.5) */
        st.load_to = 1.4;
        MUST(b, peri_solve(b, &st, NULL));
        CHECK(peri_broken_count(b) == 4 * (3 + 7));
        free(x);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(nothing_within_the_budget_is_better);
    RUN(the_first_wrong_entry_is_named);
    RUN(rows_that_zigzag);
    RUN(steps_are_refused_or_remarked);
    RUN(corners_on_the_horizon);
    RUN(strength_between_laws_leaves_the_stiffness);
    RUN(stiff_interfaces_bound_the_step);
    RUN(of_equal_limits_the_lower_compression_counts);
    return test_end("test_survivors_choice");
}
