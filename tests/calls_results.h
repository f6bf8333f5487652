/* SPDX-License-Identifier: MIT */
/* calls_results.h - a part of test_promises_calls.c: what probes, bonds in bulk, and files with fields of the caller's refuse. */
#ifndef CALLS_RESULTS_H
#define CALLS_RESULTS_H

static const int32_t of_force[1] = {PERI_FIELD_FORCE_DENSITY}, of_energy[1] = {PERI_FIELD_ENERGY_DENSITY};

static int32_t refuse_bytes(void *user, const void *bytes, int64_t count) { return (void)user, (void)bytes, (void)count, 1; }

/* All of them, of a field that its body may not have. */
static void ask_of_results(peri_body *b, int32_t field, int32_t bond) {
    static double most[5000];
    ASK(peri_get_field_at(b, field, 2, two, numbers, 512)), ASK(peri_interpolate_field(b, field, 0, 1, one3, numbers, 512));
    ASK(peri_get_bonds(b, PERI_ALL, bond, most, 5000)), ASK(peri_export_fields_to(b, &field, 1, take_bytes, NULL));
    ASK(peri_export_frame(b, "build/x.pvd", 0, &field, 1)), ASK(peri_size_of_bonds(b, PERI_ALL, bond));
    ASK(peri_export_vtu_to(b, take_bytes, NULL)), ASK(peri_export_vtu(b, "build/x"));
}

static void with_results(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED), law = plate_of(PERI_LAW_CORRESPONDENCE);
    const int32_t beyond[2] = {0, 999}, odd[1] = {7};
    peri_body *b = specimen_make(&s), *d = specimen_start(&s), *other = specimen_make(&law);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1), theirs = (int32_t)MUST(other, peri_select_ball(other, NULL, zero3, 9));
    const int32_t sets[4] = {3, material, theirs, (int32_t)MUST(b, peri_select_ball(b, NULL, zero3, 9)) + 50};
    for (int k = 0; k < 4; ++k)
        ASK(peri_size_of_bonds(b, sets[k], PERI_BOND_POINT)), ASK(peri_get_bonds(b, sets[k], PERI_BOND_POINT, numbers, 512));
    ask_of_results(NULL, PERI_FIELD_VOLUME, PERI_BOND_POINT), ask_of_results(d, PERI_FIELD_VOLUME, PERI_BOND_POINT);
    ask_of_results(b, 7, 7), peri_body_destroy(d);
    ASK(peri_get_field_at(b, PERI_FIELD_VOLUME, 2, beyond, numbers, 512)), ASK(peri_get_field_at(b, PERI_FIELD_VOLUME, 2, two, numbers, 1));
    ASK(peri_interpolate_field(b, PERI_FIELD_VOLUME, 0, 1, nan3, numbers, 512));
    ASK(peri_get_bonds(b, PERI_ALL, PERI_BOND_FORCE, numbers, 1));
    ASK(peri_interpolate_field(b, PERI_FIELD_VOLUME, 0, 1, one3, numbers, 0)), ASK(peri_export_frame(b, "build/x.pvd", -1, NULL, 0));
    ASK(peri_export_fields_to(b, odd, 1, take_bytes, NULL)), ASK(peri_export_fields_to(b, of_force, 1, refuse_bytes, NULL));
    ASK(peri_export_frame(b, "build/no_folder/x.pvd", 0, NULL, 0));
    SHORT(peri_get_field_at(b, PERI_FIELD_ENERGY_DENSITY, 2, two, numbers, 512));
    SHORT(peri_export_fields_to(b, NULL, 0, take_bytes, NULL));
    SHORT(peri_interpolate_field(b, PERI_FIELD_ENERGY_DENSITY, 0, 1, one3, numbers, 512)), SHORT(peri_export_frame(b, "x", 0, NULL, 0));
    double *all = (double *)malloc((size_t)peri_entry_count(other) * sizeof *all);
    SHORT(peri_get_bonds(other, PERI_ALL, PERI_BOND_ENERGY, all, peri_entry_count(other)));
    free(all), peri_body_destroy(other);
    peri_body_destroy(b), law.desc.precision = PERI_PRECISION_SINGLE, b = specimen_make(&law);
    for (int k = 0; k < 6; ++k) {
        (void)MUST(b, peri_apply_body_force(b, PERI_ALL, one3, vast_load, NULL));
        if (k == 0) ASK(peri_get_field_at(b, of_force[0], 2, two, numbers, 512));
        if (k == 1) ASK(peri_interpolate_field(b, of_force[0], 0, 1, one3, numbers, 512));
        if (k == 2) ASK(peri_export_fields_to(b, of_force, 1, take_bytes, NULL));
        if (k == 3) ASK(peri_export_frame(b, "build/x.pvd", 0, of_force, 1));
        double *bonds = (double *)malloc((size_t)peri_entry_count(b) * 2 * sizeof *bonds);
        if (k == 4) ASK(peri_get_bonds(b, PERI_ALL, PERI_BOND_FORCE, bonds, 2 * peri_entry_count(b)));
        free(bonds);
    }
    peri_body_destroy(b);
    b = specimen_start(&s);
    const int32_t one = peri_id(b, PERI_KIND_MATERIAL, 1);
    MUST(b, peri_set_bond_law(b, one, one, 0, broken_law, NULL)), MUST(b, peri_add_box(b, one, s.lo, s.hi, 1)), MUST(b, peri_build(b));
    ask_of_results(b, of_energy[0], PERI_BOND_ENERGY);
    peri_body_destroy(b);
}

#endif
