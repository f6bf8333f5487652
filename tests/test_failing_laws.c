/* SPDX-License-Identifier: MIT */
/* test_failing_laws.c - whose bonds a law of bonds sees, and what is told where callbacks of materials fail.

   SOURCE OF TRUTH: peri.h: a failure of a callback ends the call that it was called from, and names the first point; a law is of the bonds
   between the two materials that it was given for. Bonds that all have one stretch break at the one that peri_get_bond_constants tells. */
#include "pool.h"
#include "specimen.h"

#define SIDE   6
#define POINTS (SIDE * SIDE)

/* ---- failures --------------------------------------------------------------------------------------------------------- */

static int fails;

static int32_t failing(void *user, const peri_bond_row *row) {
    (void)user;
    for (int32_t k = 0; k < row->count; ++k) row->force[k] = row->stretch[k];
    for (int32_t k = 0; row->tangent && k < row->count; ++k) row->tangent[k] = 1;
    for (int32_t k = 0; row->energy && k < row->count; ++k) row->energy[k] = 0.5 * row->stretch[k] * row->stretch[k];
    return fails && row->point == 7 ? -1 : 0;
}

static int32_t failing_stress(void *user, const peri_stress_block *at) {
    (void)user;
    for (int64_t k = 0; k < 4 * at->count; ++k) at->stress[k] = at->gradient[k];
    for (int64_t k = 0; at->tangent && k < 16 * at->count; ++k) at->tangent[k] = k % 16 % 5 == 0;
    for (int64_t n = 0; fails && n < at->count; ++n)
        if (at->points[n] == 7) at->energy[n] = at->stress[4 * n] = (double)NAN;
    return 0;
}

static peri_body *plate(int own_stress, pool *p) {
    const int32_t law = own_stress ? PERI_LAW_CORRESPONDENCE : PERI_LAW_BOND_BASED;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 2.015, SIDE, SIDE, 1);
    if (p) hook(&s.desc, p);
    if (own_stress) s.material.stress = failing_stress;
    peri_body *b = specimen_start(&s);
    const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
    if (!own_stress) (void)MUST(b, peri_set_bond_law(b, m, m, 0, failing, NULL));
    (void)MUST(b, peri_add_box(b, m, s.lo, s.hi, 1));
    (void)MUST(b, peri_build(b));
    double u[2 * POINTS];
    uint64_t dice = 3;
    for (int k = 0; k < 2 * POINTS; ++k) u[k] = 0.01 * test_random(&dice);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * POINTS));
    return b;
}

static void told(peri_body *b, int64_t status, int own_stress) {
    peri_error e;
    CHECK(status == PERI_ERROR_CALLBACK && peri_get_error(b, &e) == PERI_OK && e.index == 7);
    CHECK(strcmp(e.field, own_stress ? "peri_stress_fn" : "peri_bond_law_fn") == 0);
}

/* All fields, read and viewed: those that ask the law say that it failed, at which point; all others are read. */
static void fields_tell_of_failures(void) {
    for (int own = 0; own < 2; ++own) {
        peri_body *b = plate(own, NULL);
        double out[3 * POINTS];
        peri_view view;
        int asked = 0;
        for (int32_t field = PERI_FIELD_POSITION; field <= PERI_FIELD_STIFFNESS; ++field) {
            const int asks = field == PERI_FIELD_ENERGY_DENSITY || field == PERI_FIELD_FORCE_STRESS || field == PERI_FIELD_FORCE_DENSITY
                             || field == PERI_FIELD_REACTION || (own && field == PERI_FIELD_STRESS);
            fails = 1;
            asked += asks;
            if (asks) {
                told(b, peri_get_field(b, field, out, 3 * POINTS), own);
                told(b, peri_view_field(b, field, &view), own);
            } else {
                (void)MUST(b, peri_get_field(b, field, out, 3 * POINTS));
                (void)MUST(b, peri_view_field(b, field, &view));
            }
            fails = 0;
            (void)MUST(b, peri_get_field(b, field, out, 3 * POINTS));
            (void)MUST(b, peri_view_field(b, field, &view));
            CHECK(view.data != NULL && view.count == POINTS);
            if (asks && (field == PERI_FIELD_FORCE_DENSITY || field == PERI_FIELD_REACTION)) { /* stale again */
                (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, out, 3 * POINTS));
                out[0] += 1e-3;
                (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, out, 2 * POINTS));
            }
        }
        CHECK(asked == 4 + own);
        peri_body_destroy(b);
    }
}

static void matrices_tell_of_failures(void) {
    pool p = {0, 0, 0, 0, -1, 0};
    peri_body *b = plate(0, &p);
    peri_matrix *matrix = NULL;
    const int64_t held = p.bytes;
    fails = 1;
    told(b, peri_matrix_create(b, &matrix), 0);
    CHECK(matrix == NULL && p.bytes == held);
    fails = 0;
    (void)MUST(b, peri_matrix_create(b, &matrix));
    CHECK(matrix != NULL);
    peri_matrix_destroy(matrix);
    peri_body_destroy(b);
    CHECK(p.blocks == 0 && p.bytes == 0 && p.wrong == 0);
}

/* Changes that have to know the energy before them: they say that it failed, and change nothing. */
static void changes_tell_of_failures(void) {
    const double from[2] = {2.9, -1}, to[2] = {2.9, 9}, v[2] = {0.01, 0.02};
    const int32_t pair[2] = {0, 1};
    double field[2 * POINTS], now[2 * POINTS];
    for (int own = 0; own < 2; ++own)
        for (int k = 0; k < 6; ++k) {
            peri_body *b = plate(own, NULL);
            peri_advance_desc a;
            peri_energy e;
            peri_contact_desc contact;
            peri_advance_desc_init(&a), a.steps = 2;
            (void)MUST(b, peri_advance(b, &a));
            (void)MUST(b, peri_get_energy(b, &e));
            (void)MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, field, 2 * POINTS));
            peri_contact_desc_init(&contact);
            for (int turn = 0; turn < 2; ++turn) {
                fails = turn == 0;
                field[3] += 0.5;
                const int64_t said = k == 0   ? peri_add_velocity(b, PERI_ALL, v)
                                     : k == 1 ? peri_add_displacement(b, PERI_ALL, v)
                                     : k == 2 ? peri_set_field(b, PERI_FIELD_VELOCITY, field, 2 * POINTS)
                                     : k == 3 ? peri_cut_segment(b, PERI_CUT_NOW, from, to)
                                     : k == 4 ? peri_cut_pairs(b, PERI_CUT_NOW, 1, pair)
                                              : peri_set_contact(b, PERI_ALL, PERI_ALL, &contact);
                fails = 0;
                if (k == 5 && own && turn == 1 && said < 0) continue; /* contact is refused there, anyway */
                if (turn == 0 && !(k == 5 && own && said != PERI_ERROR_CALLBACK)) told(b, said, own);
                if (turn == 1) CHECK(said >= 0);
                if (turn == 1) continue;
                const double before = e.error;
                (void)MUST(b, peri_get_energy(b, &e));
                CHECK(e.error == before && peri_broken_count(b) == 0);
                (void)MUST(b, peri_get_field(b, PERI_FIELD_VELOCITY, now, 2 * POINTS));
                CHECK(k == 2 || memcmp(now, field, sizeof(double) * 3) == 0);
            }
            peri_body_destroy(b);
        }
}

/* ---- bonds of other pairs ---------------------------------------------------------------------------------------------- */

typedef struct sight { /* what a law has seen, and whether each bond was its own                                                */
    int32_t material[POINTS];
    int32_t one, other, states;
    int64_t bonds, strange;
} sight;

/* Linear; its states count how often each bond was kept, and know whose they are. */
static int32_t looking(void *user, const peri_bond_row *row) {
    sight *t = (sight *)user;
    for (int32_t k = 0; k < row->count; ++k) {
        const int32_t a = t->material[row->point], c = t->material[row->others[k]];
        const int own = (a == t->one && c == t->other) || (a == t->other && c == t->one);
        t->bonds++;
        t->strange += !own;
        row->force[k] = row->stretch[k];
        if (row->tangent) row->tangent[k] = 1;
        if (row->energy) row->energy[k] = 0.5 * row->stretch[k] * row->stretch[k];
        for (int32_t n = 0; row->lost && n < t->states; ++n) {
            const double mark = 1000.0 * t->one + 100.0 * t->other + n;
            double *state = &row->state[k * t->states + n];
            t->strange += *state != 0 && *state != mark;
            *state = mark;
        }
    }
    return 0;
}

/* Stripes of two materials. laws: bit 0 of the bonds within the first, 1 between them, 2 within the second. */
static peri_body *stripes(int laws, sight *sights) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.015, SIDE, SIDE, 1);
    double material[POINTS];
    peri_body *b = specimen_start(&s);
    const int32_t one = peri_id(b, PERI_KIND_MATERIAL, 1);
    s.material.young = 3;
    const int32_t two = (int32_t)MUST(b, peri_add_material(b, &s.material)), ids[3][2] = {{one, one}, {two, one}, {two, two}};
    for (int k = 0; k < 3; ++k) {
        sights[k].one = PERI_ID_INDEX(ids[k][0]);
        sights[k].other = PERI_ID_INDEX(ids[k][1]);
        sights[k].states = 1 + 2 * k;
        sights[k].bonds = sights[k].strange = 0;
        if (laws >> k & 1) (void)MUST(b, peri_set_bond_law(b, ids[k][0], ids[k][1], sights[k].states, looking, &sights[k]));
    }
    for (int k = 0; k < SIDE; ++k) {
        const double lo[2] = {k, 0}, hi[2] = {k + 1, SIDE};
        (void)MUST(b, peri_add_box(b, k % 3 == 1 ? two : one, lo, hi, 1));
    }
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_MATERIAL, material, POINTS));
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < POINTS; ++i) sights[k].material[i] = (int32_t)material[i];
    return b;
}

/* Whichever pairs have a linear law of the caller's, the body moves as without any, and each law sees its own bonds alone. */
static void laws_see_their_own_bonds(void) {
    sight sights[3];
    double u[2 * POINTS], plain[2 * POINTS], f[2 * POINTS], elastic = 0;
    for (int laws = 0; laws < 8; ++laws) {
        peri_body *b = stripes(laws, sights);
        uint64_t dice = 5;
        peri_advance_desc a;
        peri_energy e;
        peri_matrix *matrix = NULL;
        for (int k = 0; k < 2 * POINTS; ++k) u[k] = 0.01 * test_random(&dice);
        (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 2 * POINTS));
        peri_advance_desc_init(&a);
        a.steps = 5;
        a.time_step = 0.2;
        (void)MUST(b, peri_advance(b, &a));
        (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, laws ? f : plain, 2 * POINTS));
        for (int k = 0; laws && k < 2 * POINTS; ++k) CHECK_NEAR(f[k], plain[k], 1e-12, 1e-14);
        (void)MUST(b, peri_get_energy(b, &e));
        if (laws == 0) elastic = e.elastic;
        CHECK_NEAR(e.elastic, elastic, 1e-11, 0);
        (void)MUST(b, peri_matrix_create(b, &matrix));
        peri_matrix_destroy(matrix);
        (void)MUST(b, peri_get_field(b, PERI_FIELD_FORCE_STRESS, (double[3 * POINTS]){0}, 3 * POINTS));
        for (int k = 0; k < 3; ++k) CHECK(sights[k].strange == 0 && (sights[k].bonds > 0) == (laws >> k & 1));
        peri_body_destroy(b);
    }
}

/* ---- where softening bonds break ----------------------------------------------------------------------------------------- */

/* All bonds are stretched alike. Returns how many have broken. */
static int64_t broken_at(peri_body *b, double stretch) {
    double x[2 * POINTS];
    peri_evaluate_desc e;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_POSITION, x, 2 * POINTS));
    for (int k = 0; k < 2 * POINTS; ++k) x[k] *= stretch;
    peri_evaluate_desc_init(&e);
    e.displacement = x;
    e.fracture = 1;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    return peri_broken_count(b);
}

static void constants_tell_where_softening_bonds_break(void) {
    for (int brittle = 0; brittle < 2; ++brittle) {
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2.015, SIDE, SIDE, 1);
        peri_softening_desc table;
        peri_error error;
        double c, s0 = 0;
        s.material.critical_stretch = 0.5;
        s.desc.influence = PERI_INFLUENCE_CONSTANT;
        peri_softening_desc_init(&table, PERI_SOFTENING_BILINEAR);
        table.strength = brittle ? 1 : 1e-2;
        table.fracture_energy = 1e-3;
        peri_body *b = specimen_start(&s);
        const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
        CHECK(peri_set_softening(b, m, m, &table) == (brittle ? PERI_BRITTLE : PERI_OK));
        (void)MUST(b, peri_get_bond_constants(b, m, m, &c, NULL));
        CHECK(peri_get_bond_constants(b, m, m, &c, &s0) == PERI_ERROR_ORDER && peri_get_error(b, &error) == PERI_OK);
        CHECK(strcmp(error.field, "peri_build") == 0);
        (void)MUST(b, peri_add_box(b, m, s.lo, s.hi, 1));
        (void)MUST(b, peri_build(b));
        (void)MUST(b, peri_get_bond_constants(b, m, m, &c, &s0));
        CHECK(s0 > 0.01 && s0 < 0.49 && c > 0);
        CHECK(broken_at(b, 0.999 * s0) == 0);
        CHECK(broken_at(b, 1.001 * s0) == peri_entry_count(b) / 2);
        peri_body_destroy(b);
    }
}

/* ---- a density that is what it was -------------------------------------------------------------------------------------- */

static void same_density_takes_no_memory(void) {
    pool p = {0, 0, 0, 0, -1, 0};
    peri_body *b = plate(0, &p);
    double rho[POINTS], kept[POINTS];
    const int64_t held = p.bytes;
    const double step = peri_stable_step(b);
    fails = 0;
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DENSITY, rho, POINTS));
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DENSITY, rho, POINTS));
    CHECK(p.bytes == held && peri_stable_step(b) == step);
    rho[POINTS - 1] *= 4;
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DENSITY, rho, POINTS));
    CHECK(p.bytes > held);
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DENSITY, kept, POINTS));
    CHECK(memcmp(kept, rho, sizeof rho) == 0);
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(fields_tell_of_failures);
    RUN(matrices_tell_of_failures);
    RUN(changes_tell_of_failures);
    RUN(laws_see_their_own_bonds);
    RUN(constants_tell_where_softening_bonds_break);
    RUN(same_density_takes_no_memory);
    return test_end("test_failing_laws");
}
