/* SPDX-License-Identifier: MIT */
/* without.c - what a build leaves out by a switch: declared as ever, answering PERI_ERROR_LEFT_OUT with the switch as the field. */
#ifndef PERI_IMPL
#error "a part of peri_impl.c; compile that"
#endif

#if defined(PERI_NO_STATICS) || defined(PERI_NO_OUTPUT)
static int32_t peri__without(peri_body *b, const char *name) {
    return b ? peri__fail(b, PERI_ERROR_LEFT_OUT, name, -1, 0.0) : PERI_ERROR_ARGUMENT;
}
#endif

#ifdef PERI_NO_STATICS
PERI_API void peri_solve_desc_init(peri_solve_desc *st) {
    if (st) memset(st, 0, sizeof *st);
}

PERI_API int32_t peri_solve(peri_body *b, const peri_solve_desc *st, peri_solve_report *report) {
    (void)st;
    if (report) memset(report, 0, sizeof *report);
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API int32_t peri_advance_implicit(peri_body *b, const peri_advance_desc *advance, const peri_solve_desc *solve, double rho,
                                       peri_solve_report *report) {
    (void)advance, (void)solve, (void)rho;
    if (report) memset(report, 0, sizeof *report);
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API int32_t peri_apply_traction(peri_body *b, int32_t set, double area, const double *normal, const double *value,
                                             peri_load_fn fn, void *user) {
    (void)set, (void)area, (void)normal, (void)value, (void)fn, (void)user;
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API int32_t peri_apply_pressure(peri_body *b, int32_t set, double pressure, peri_load_fn fn, void *user) {
    (void)set, (void)pressure, (void)fn, (void)user;
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API int32_t peri_apply_bond_pressure_for_comparison(peri_body *b, int32_t set, double pressure, peri_load_fn fn, void *user) {
    (void)set, (void)pressure, (void)fn, (void)user;
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API int32_t peri_multiply_stiffness(peri_body *b, const double *in, double *out, int64_t count) {
    (void)in, (void)out, (void)count;
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API int32_t peri_multiply_stiffness_at(peri_body *b, const double *displacement, const double *in, double *out, int64_t count) {
    (void)displacement, (void)in, (void)out, (void)count;
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API int32_t peri_matrix_create(peri_body *b, peri_matrix **matrix) {
    if (matrix) *matrix = NULL;
    return peri__without(b, "PERI_NO_STATICS");
}

PERI_API void peri_matrix_destroy(peri_matrix *a) { (void)a; }

PERI_API int64_t peri_matrix_rows(const peri_matrix *a) { return a ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT; }

PERI_API int64_t peri_matrix_entries(const peri_matrix *a) { return a ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT; }

PERI_API int32_t peri_get_matrix(const peri_matrix *a, int64_t *start, int32_t *column, double *value) {
    (void)start, (void)column, (void)value;
    return a ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT;
}

PERI_API int32_t peri_export_matrix_to(const peri_matrix *a, peri_write_fn write, void *user) {
    (void)write, (void)user;
    return a ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT;
}
#endif

#ifdef PERI_NO_OUTPUT
PERI_API int32_t peri_export_vtu_to(peri_body *b, peri_write_fn write, void *user) {
    (void)write, (void)user;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_export_fields_to(peri_body *b, const int32_t *fields, int64_t count, peri_write_fn write, void *user) {
    (void)fields, (void)count, (void)write, (void)user;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_export_history_to(peri_body *b, int32_t header, peri_write_fn write, void *user) {
    (void)header, (void)write, (void)user;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_get_field_at(peri_body *b, int32_t field, int64_t count, const int32_t *points, double *out, int64_t capacity) {
    (void)field, (void)count, (void)points, (void)out, (void)capacity;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_interpolate_field(peri_body *b, int32_t field, int32_t in_place, int64_t count, const double *places, double *out,
                                        int64_t capacity) {
    (void)field, (void)in_place, (void)count, (void)places, (void)out, (void)capacity;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int64_t peri_size_of_bonds(const peri_body *b, int32_t set, int32_t bond) {
    (void)set, (void)bond;
    return peri__without((peri_body *)b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_get_bonds(peri_body *b, int32_t set, int32_t bond, double *out, int64_t capacity) {
    (void)set, (void)bond, (void)out, (void)capacity;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API void peri_cracks_desc_init(peri_cracks_desc *desc) {
    if (desc) memset(desc, 0, sizeof *desc);
}

PERI_API int32_t peri_cracks_create(peri_body *b, const peri_cracks_desc *desc, peri_cracks **cracks) {
    (void)desc;
    if (cracks) *cracks = NULL;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API void peri_cracks_destroy(peri_cracks *c) { (void)c; }

PERI_API int64_t peri_cracks_paths(const peri_cracks *c) { return c ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT; }

PERI_API int64_t peri_cracks_vertices(const peri_cracks *c) { return c ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT; }

PERI_API int64_t peri_cracks_tips(const peri_cracks *c) { return c ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT; }

PERI_API double peri_cracks_size(const peri_cracks *c) {
    (void)c;
    return 0.0;
}

PERI_API int32_t peri_get_cracks(const peri_cracks *c, int64_t *start, double *vertex, double *time, peri_crack_tip *tip) {
    (void)start, (void)vertex, (void)time, (void)tip;
    return c ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT;
}

PERI_API int32_t peri_export_cracks_to(const peri_cracks *c, peri_write_fn write, void *user) {
    (void)write, (void)user;
    return c ? PERI_ERROR_LEFT_OUT : PERI_ERROR_ARGUMENT;
}

PERI_API int32_t peri_size_of_outline(peri_body *b, int32_t fragment, int64_t *vertices, int64_t *faces) {
    (void)fragment, (void)vertices, (void)faces;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_get_outline(peri_body *b, int32_t fragment, double *vertices, int64_t vertex_capacity, int32_t *faces,
                                  int32_t *owners, int32_t *inner, int64_t face_capacity) {
    (void)fragment, (void)vertices, (void)vertex_capacity, (void)faces, (void)owners, (void)inner, (void)face_capacity;
    return peri__without(b, "PERI_NO_OUTPUT");
}

#ifndef PERI_NO_STDIO
PERI_API int32_t peri_export_vtu(peri_body *b, const char *path) {
    (void)path;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_export_frame(peri_body *b, const char *path, int64_t frame, const int32_t *fields, int64_t count) {
    (void)path, (void)frame, (void)fields, (void)count;
    return peri__without(b, "PERI_NO_OUTPUT");
}

PERI_API int32_t peri_export_history(peri_body *b, const char *path, int32_t append) {
    (void)path, (void)append;
    return peri__without(b, "PERI_NO_OUTPUT");
}
#endif
#endif

#ifdef PERI_NO_ADVICE
PERI_API void peri_plan_desc_init(peri_plan_desc *plan) {
    if (plan) memset(plan, 0, sizeof *plan);
}

PERI_API void peri_choose_desc_init(peri_choose_desc *goal) {
    if (goal) memset(goal, 0, sizeof *goal);
}

PERI_API int32_t peri_plan(const peri_plan_desc *plan, peri_plan_report *report, peri_error *error) {
    (void)plan;
    if (report) memset(report, 0, sizeof *report);
    return peri__set_error(error, PERI_ERROR_LEFT_OUT, "PERI_NO_ADVICE", -1, 0.0);
}

PERI_API int32_t peri_choose(const peri_choose_desc *goal, peri_body_desc *body, peri_material_desc *material,
                             peri_choose_report *choice, peri_error *error) {
    (void)goal, (void)body, (void)material, (void)choice;
    return peri__set_error(error, PERI_ERROR_LEFT_OUT, "PERI_NO_ADVICE", -1, 0.0);
}
#endif
