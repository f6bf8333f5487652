/* SPDX-License-Identifier: MIT */
/* calls_laws.h - a part of test_promises_calls.c: what calls about laws of bonds refuse. */
#ifndef CALLS_LAWS_H
#define CALLS_LAWS_H

/* Laws of bonds: all that is wrong, and more pairs than there may be. */
static int32_t no_law(void *user, const peri_bond_row *row) { return (void)user, (void)row, 0; }
static int32_t broken_law(void *user, const peri_bond_row *row) { return (void)user, (void)row, -1; }
static int32_t failing_influence(void *user, double q, double *w) { return (void)user, (void)q, (void)w, -1; }
static int32_t nan_influence(void *user, double q, double *w) { return (void)user, (void)q, *w = (double)NAN, 0; }
static void with_wrong_laws(void) {
    specimen s = plate_of(PERI_LAW_BOND_BASED);
    peri_softening_desc d;
    int32_t id[24];
    int made = 0;
    peri_body *b = specimen_start(&s);
    peri_material_desc lps = s.material;
    lps.law = PERI_LAW_LPS, lps.poisson = 0.2;
    id[0] = peri_id(b, PERI_KIND_MATERIAL, 1);
    const int32_t state = (int32_t)MUST(b, peri_add_material(b, &lps));
    peri_softening_desc_init(&d, PERI_SOFTENING_BILINEAR);
    ASK(peri_set_softening(b, id[0], id[0], &d)), d.strength = d.fracture_energy = 1;
    d.cookie = 0, ASK(peri_set_softening(b, id[0], id[0], &d)), peri_softening_desc_init(&d, 7), d.strength = d.fracture_energy = 1;
    ASK(peri_set_softening(b, id[0], id[0], &d)), d.shape = PERI_SOFTENING_TABLE, ASK(peri_set_softening(b, id[0], id[0], &d));
    d.shape = PERI_SOFTENING_BILINEAR, ASK(peri_set_softening(b, state, id[0], &d));
    ASK(peri_set_bond_law(b, state, id[0], 0, no_law, NULL));
    ASK(peri_set_softening(b, 0, id[0], &d)), ASK(peri_set_softening(b, PERI_ALL, id[0], &d));
    ASK(peri_set_softening(b, id[0], state + 9, &d));
    ASK(peri_set_softening(b, id[0], id[0] ^ 1 << 20, &d)), ASK(peri_set_bond_law(b, id[0], id[0] ^ 1 << 20, 0, no_law, NULL));
    ASK(peri_set_bond_law(b, id[0], state + 9, 0, no_law, NULL));
    SHORT(peri_set_bond_law(b, id[0], id[0], 0, no_law, NULL));
    for (int k = 1; k < 24; ++k) id[k] = (int32_t)MUST(b, peri_add_material(b, &s.material));
    for (int k = 0; k < 24; ++k)
        for (int n = 0; n <= k && made < 255; ++n, ++made) (void)MUST(b, peri_set_bond_law(b, id[k], id[n], 0, no_law, NULL));
    ASK(peri_set_bond_law(b, id[23], id[23], 0, no_law, NULL)), ASK(peri_set_softening(b, id[23], id[23], &d));
    peri_body_destroy(b);
    for (int k = 0; k < 3; ++k) {
        s = plate_of(PERI_LAW_BOND_BASED);
        if (k < 2) s.desc.influence = PERI_INFLUENCE_USER, s.desc.influence_fn = k ? failing_influence : nan_influence;
        b = specimen_start(&s);
        if (k < 2) ASK(peri_set_softening(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &d));
        else SHORT(peri_set_softening(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), &d));
        peri_body_destroy(b);
    }
    b = specimen_make(&s);
    id[0] = peri_id(b, PERI_KIND_MATERIAL, 1);
    ASK(peri_get_softening(b, PERI_ALL, id[0], NULL, NULL)), ASK(peri_get_softening(b, id[0] + 1, id[0], NULL, NULL));
    ASK(peri_get_softening(b, id[0] ^ 1 << 20, id[0], NULL, NULL));
    peri_body_destroy(b);
    b = specimen_start(&s);
    id[0] = peri_id(b, PERI_KIND_MATERIAL, 1);
    d.strength = 1e6, ASK(peri_set_softening(b, id[0], id[0], &d)), MUST(b, peri_add_box(b, id[0], s.lo, s.hi, 1)), MUST(b, peri_build(b));
    ASK(peri_get_softening(b, id[0], id[0], NULL, NULL));
    peri_body_destroy(b);
    b = specimen_start(&s);
    id[0] = peri_id(b, PERI_KIND_MATERIAL, 1);
    MUST(b, peri_set_bond_law(b, id[0], id[0], 0, broken_law, NULL)), MUST(b, peri_add_box(b, id[0], s.lo, s.hi, 1));
    MUST(b, peri_build(b));
    ASK(peri_get_energy(b, &energy)), ASK(peri_multiply_stiffness_at(b, numbers, numbers, numbers, 240));
    peri_body_destroy(b);
}

#endif
