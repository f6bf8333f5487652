/* SPDX-License-Identifier: MIT */
/* switches.c - the library with parts left out. Compiled with the same switches as the library it is linked to: prints a line per scene
   that is there, made of all bits of its results, and fails where what is left out answers otherwise than by PERI_ERROR_LEFT_OUT and the
   switch.
   SOURCE OF TRUTH: the whole library: every line must be among those that it prints (checks.sh compares). */
#include "peri_test.h"

/* The name of each switch that is set, else NULL. */
#ifdef PERI_NO_2D
static const char *const no_2d = "PERI_NO_2D";
#else
static const char *const no_2d = NULL;
#endif
#ifdef PERI_NO_3D
static const char *const no_3d = "PERI_NO_3D";
#else
static const char *const no_3d = NULL;
#endif
#ifdef PERI_NO_F64
static const char *const no_f64 = "PERI_NO_F64";
#else
static const char *const no_f64 = NULL;
#endif
#ifdef PERI_NO_MIXED
static const char *const no_mixed = "PERI_NO_MIXED";
#else
static const char *const no_mixed = NULL;
#endif
#ifdef PERI_NO_F32
static const char *const no_f32 = "PERI_NO_F32";
#else
static const char *const no_f32 = NULL;
#endif
#ifdef PERI_NO_STATICS
static const char *const no_statics = "PERI_NO_STATICS";
#else
static const char *const no_statics = NULL;
#endif
#ifdef PERI_NO_ADVICE
static const char *const no_advice = "PERI_NO_ADVICE";
#else
static const char *const no_advice = NULL;
#endif
#ifdef PERI_NO_OUTPUT
static const char *const no_output = "PERI_NO_OUTPUT";
#else
static const char *const no_output = NULL;
#endif

static const struct {
    int32_t     value;
    const char *name;
} precisions[3] = { { PERI_PRECISION_DOUBLE, "double" }, { PERI_PRECISION_MIXED, "mixed" }, { PERI_PRECISION_SINGLE, "single" } };

static const char *without_precision(int p) { return p == 0 ? no_f64 : p == 1 ? no_mixed : no_f32; }

static const char *without_space(int dim) { return dim == 2 ? no_2d : no_3d; }

static int says_left_out(int64_t status, const peri_error *error, const char *without) {
    return status == PERI_ERROR_LEFT_OUT && error->code == PERI_ERROR_LEFT_OUT && strcmp(error->field, without) == 0;
}

static int32_t mix(void *user, const void *bytes, int64_t count) { /* a peri_write_fn */
    uint64_t *hash = (uint64_t *)user;
    for (int64_t k = 0; k < count; ++k) *hash = (*hash ^ ((const unsigned char *)bytes)[k]) * UINT64_C(0x100000001B3);
    return 0;
}

static void show(const char *what, int p, int dim, uint64_t hash) {
    printf("%s %dD %s %016llx\n", what, dim, precisions[p].name, (unsigned long long)hash);
}

static void show_field(const char *what, int p, int dim, peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(b, field);
    double *values = (double *)malloc((size_t)n * sizeof *values);
    uint64_t hash = 0;
    MUST(b, peri_get_field(b, field, values, n));
    (void)mix(&hash, values, n * (int64_t)sizeof *values);
    show(what, p, dim, hash);
    free(values);
}

/* A call that is left out: the status, and the switch as the field of the body's record. */
static void left_out(const peri_body *b, int64_t status, const char *without) {
    peri_error error;
    CHECK(peri_get_error(b, &error) == PERI_OK && says_left_out(status, &error, without));
}

static void try_statics(peri_body *b, int p, int dim) {
    const double normal[3] = { 0, 1, 0 };
    double work[1] = { 0 };
    peri_solve_desc st;
    peri_solve_report report;
    peri_matrix *matrix = NULL;
    peri_solve_desc_init(&st);
    const int32_t solved = peri_solve(b, &st, &report);
    if (!no_statics) {
        MUST(b, solved);
        show_field("statics", p, dim, b, PERI_FIELD_STRESS);
        MUST(b, peri_matrix_create(b, &matrix));
        CHECK(peri_matrix_rows(matrix) == peri_size_of_field(b, PERI_FIELD_DISPLACEMENT) && peri_matrix_entries(matrix) > 0);
        peri_matrix_destroy(matrix);
        return;
    }
    left_out(b, solved, no_statics);
    CHECK(report.iterations == 0);
    left_out(b, peri_advance_implicit(b, NULL, &st, 1.0, &report), no_statics);
    left_out(b, peri_apply_traction(b, PERI_ALL, 1.0, normal, normal, NULL, NULL), no_statics);
    left_out(b, peri_apply_pressure(b, PERI_ALL, 1.0, NULL, NULL), no_statics);
    left_out(b, peri_apply_bond_pressure_for_comparison(b, PERI_ALL, 1.0, NULL, NULL), no_statics);
    left_out(b, peri_multiply_stiffness(b, work, work, 1), no_statics);
    left_out(b, peri_multiply_stiffness_at(b, work, work, work, 1), no_statics);
    left_out(b, peri_matrix_create(b, &matrix), no_statics);
    CHECK(matrix == NULL && peri_matrix_rows(matrix) == PERI_ERROR_ARGUMENT && peri_matrix_entries(matrix) == PERI_ERROR_ARGUMENT);
    CHECK(peri_get_matrix(matrix, NULL, NULL, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_export_matrix_to(matrix, mix, NULL) == PERI_ERROR_ARGUMENT);
    peri_matrix_destroy(matrix);
    CHECK(peri_solve(NULL, &st, NULL) == PERI_ERROR_ARGUMENT);
}

static void try_output(peri_body *b, int p, int dim) {
    uint64_t hash = 0;
    const int32_t vtu = peri_export_vtu_to(b, mix, &hash), history = peri_export_history_to(b, 1, mix, &hash);
    peri_cracks_desc desc;
    peri_cracks *cracks = NULL;
    peri_cracks_desc_init(&desc);
    const int32_t found = peri_cracks_create(b, &desc, &cracks), exported = cracks ? peri_export_cracks_to(cracks, mix, &hash) : 0;
    peri_cracks_destroy(cracks);
    static double vertices[20000];
    static int32_t triangles[40000];
    int64_t count[2];
    static double bonds[60000], place[3] = {0.5, 0.5, 0.5};
    const int32_t points[2] = {1, 0}, energy = PERI_FIELD_ENERGY_DENSITY;
    if (!no_output) {
        const int64_t need = MUST(b, peri_size_of_bonds(b, PERI_ALL, PERI_BOND_FORCE));
        CHECK(need <= 60000);
        MUST(b, peri_get_bonds(b, PERI_ALL, PERI_BOND_FORCE, bonds, need));
        (void)mix(&hash, bonds, need * (int64_t)sizeof *bonds);
        MUST(b, peri_get_field_at(b, energy, 2, points, bonds, 2));
        MUST(b, peri_interpolate_field(b, energy, 0, 1, place, bonds + 2, 1));
        (void)mix(&hash, bonds, 3 * (int64_t)sizeof *bonds);
        MUST(b, peri_export_fields_to(b, &energy, 1, mix, &hash));
        MUST(b, vtu);
        MUST(b, history);
        MUST(b, found);
        CHECK(exported == PERI_OK);
        MUST(b, peri_size_of_outline(b, -1, &count[0], &count[1]));
        CHECK(count[0] * dim <= 20000 && count[1] * dim <= 40000);
        MUST(b, peri_get_outline(b, -1, vertices, count[0], triangles, NULL, NULL, count[1]));
        (void)mix(&hash, vertices, count[0] * dim * (int64_t)sizeof *vertices);
        (void)mix(&hash, triangles, count[1] * dim * (int64_t)sizeof *triangles);
        show("output", p, dim, hash);
        return;
    }
    CHECK(hash == 0);
    left_out(b, vtu, no_output);
    left_out(b, peri_size_of_bonds(b, PERI_ALL, PERI_BOND_FORCE), no_output);
    left_out(b, peri_get_bonds(b, PERI_ALL, PERI_BOND_FORCE, bonds, 60000), no_output);
    left_out(b, peri_get_field_at(b, energy, 2, points, bonds, 2), no_output);
    left_out(b, peri_interpolate_field(b, energy, 0, 1, place, bonds, 1), no_output);
    left_out(b, peri_export_fields_to(b, &energy, 1, mix, &hash), no_output);
    left_out(b, history, no_output);
    left_out(b, found, no_output);
    CHECK(cracks == NULL && peri_cracks_size(cracks) == 0 && peri_cracks_tips(cracks) == PERI_ERROR_ARGUMENT);
    CHECK(peri_cracks_paths(cracks) == PERI_ERROR_ARGUMENT && peri_cracks_vertices(cracks) == PERI_ERROR_ARGUMENT);
    CHECK(peri_get_cracks(cracks, NULL, NULL, NULL, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_export_cracks_to(cracks, mix, &hash) == PERI_ERROR_ARGUMENT);
    left_out(b, peri_size_of_outline(b, -1, &count[0], &count[1]), no_output);
    left_out(b, peri_get_outline(b, -1, vertices, 0, triangles, NULL, NULL, 0), no_output);
#ifndef PERI_NO_STDIO
    left_out(b, peri_export_vtu(b, "build/checks/left_out.vtu"), no_output);
    left_out(b, peri_export_frame(b, "build/checks/left_out.pvd", 0, NULL, 0), no_output);
    left_out(b, peri_export_history(b, "build/checks/left_out.csv", 0), no_output);
#endif
}

static void try_advice(const peri_body_desc *d, const peri_material_desc *m, const double *lo, const double *hi, int p, int dim) {
    peri_plan_desc plan;
    peri_plan_report report;
    peri_error error;
    peri_plan_desc_init(&plan);
    plan.body = d;
    plan.material = m;
    plan.spacing = 1.0;
    memcpy(plan.lo, lo, sizeof plan.lo);
    memcpy(plan.hi, hi, sizeof plan.hi);
    const int32_t planned = peri_plan(&plan, &report, &error);
    if (!no_advice) {
        uint64_t hash = 0;
        CHECK(planned == PERI_OK);
        (void)mix(&hash, &report.entries, (int64_t)sizeof report.entries);
        (void)mix(&hash, &report.stable_step, (int64_t)sizeof report.stable_step);
        show("advice", p, dim, hash);
        return;
    }
    CHECK(says_left_out(planned, &error, no_advice) && report.entries == 0);
}

/* A box that is pulled apart, then at rest under its grips. */
static void scene(int32_t law, int p, int dim) {
    const double lo[3] = { 0, 0, 0 }, hi[3] = { 10, 5, 3 }, half[3] = { 5, 5, 3 }, left[3] = { 1, 5, 3 }, right[3] = { 9, 0, 0 };
    const double pull[3] = { 0.4, 0.02, 0 }, way[3] = { 0.01, 0, 0 };
    const char *without = without_space(dim) ? without_space(dim) : without_precision(p);
    peri_body_desc d;
    peri_material_desc m;
    peri_advance_desc run;
    peri_error error;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN;
    d.precision = precisions[p].value;
    d.horizon = 2.6;
    const int32_t created = peri_body_create(&d, &b, &error);
    if (without) {
        CHECK(says_left_out(created, &error, without) && b == NULL);
        return;
    }
    CHECK(created == PERI_OK);
    peri_material_desc_init(&m, law);
    m.young = m.density = 1;
    m.critical_stretch = 0.03;
    if (law != PERI_LAW_BOND_BASED) m.poisson = 0.2;
    const int32_t id = (int32_t)MUST(b, peri_add_material(b, &m));
    MUST(b, peri_add_box(b, id, lo, hi, 1.0));
    MUST(b, peri_build(b));
    MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, half)), pull));
    peri_advance_desc_init(&run);
    run.steps = 10;
    MUST(b, peri_advance(b, &run));
    CHECK(peri_broken_count(b) > 10);
    show_field(law == PERI_LAW_BOND_BASED ? "bond-based" : "correspondence", p, dim, b, PERI_FIELD_DISPLACEMENT);
    try_output(b, p, dim);
    MUST(b, peri_reset(b));
    const int32_t axes = dim == 2 ? PERI_AXIS_XY : PERI_AXIS_XYZ;
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, left)), axes, NULL, NULL, NULL));
    MUST(b, peri_prescribe_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, right, hi)), axes, way, NULL, NULL));
    try_statics(b, p, dim);
    try_advice(&d, &m, lo, hi, p, dim);
    peri_body_destroy(b);
}

/* Named presets, in every space: the best of the precisions that are there. */
static void try_choose(int dim) {
    peri_choose_desc goal;
    peri_body_desc d;
    peri_material_desc m;
    peri_choose_report choice;
    peri_error error;
    peri_choose_desc_init(&goal);
    goal.preset = PERI_PRESET_GAME;
    goal.quantity = PERI_QUANTITY_DEFORMATION;
    goal.feature = 1.0;
    for (int k = 0; k < 3; ++k) goal.hi[k] = 1.0;
    peri_body_desc_init(&d);
    d.space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
    peri_material_desc_init(&m, PERI_LAW_LPS);
    m.young = m.density = 1.0;
    m.poisson = 0.3;
    const int32_t chosen = peri_choose(&goal, &d, &m, &choice, &error);
    const char *without = no_advice ? no_advice : without_space(dim);
    if (without) CHECK(says_left_out(chosen, &error, without));
    else if (no_f64 && no_f32) CHECK(chosen == PERI_ERROR_RANGE); /* nothing was measured in mixed precision */
    else {
        CHECK(chosen == PERI_OK && choice.cost.entries > 0);
        CHECK(!(d.precision == PERI_PRECISION_DOUBLE && no_f64) && !(d.precision == PERI_PRECISION_SINGLE && no_f32));
        CHECK(d.precision != PERI_PRECISION_MIXED);
    }
}

int main(void) {
    for (int p = 0; p < 3; ++p)
        for (int dim = 2; dim <= 3; ++dim) {
            scene(PERI_LAW_BOND_BASED, p, dim);
            scene(PERI_LAW_CORRESPONDENCE, p, dim);
        }
    try_choose(2);
    try_choose(3);
    CHECK(strcmp(peri_status_text(PERI_ERROR_LEFT_OUT), "unknown status") != 0);
    return test_bad != 0;
}
