/* SPDX-License-Identifier: MIT */
/* test_strengths_life.c - criteria of stress, of what is confined, of rate and of delay in a body that lives: clones, states, resets,
   threads, kernels, no-fail zones, memory, and materials that lack or contradict something.

   SOURCE OF TRUTH: what peri.h promises of any body: a copy runs on with the same bits, so does a saved state; results have the same bits
   for any number of threads; kernels agree to rounding; the ledger closes; the plan of a box is exact; a call that fails changes
   nothing, and names the field. */
#include "pool.h"
#include "restart_scene.h"

static scene scene_at(int k, int32_t criterion) {
    static const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE};
    scene s = scene_of(peri__first_law + k % 4, criterion, precisions[(k + criterion) % 3], k / 4 % 2);
    if (k % 8 == 3 || k % 8 == 4) s.space = PERI_SPACE_SOLID;
    if (k % 8 == 1) s.space = PERI_SPACE_PLANE_STRAIN;
    if (k % 3 == 1) s.geometry = PERI_GEOMETRY_LINEAR;
    if (k % 5 >= 3) s.timing = PERI_BREAK_AFTER_DRIFT;
    return s;
}

static int32_t first_new(void) { return PERI_CRITERION_PRINCIPAL_STRESS; }

static void copies_run_on(void) {
    int32_t criterion;
    int k;
    for (criterion = first_new(); criterion < peri__end_criterion; ++criterion) {
        int64_t broken = 0;
        for (k = 0; k < 8; ++k) {
            scene s = scene_at(k, criterion);
            peri_body *a = scene_make(&s), *c = NULL, *b, *many;
            buffer state = {NULL, 0, 0, 0};
            peri_energy e;
            s.threads = 3;
            many = scene_make(&s);
            b = scene_make(&s);
            (void)scene_run(a, 12);
            MUST(a, peri_body_clone(a, &c, NULL));
            save(a, &state);
            CHECK(load(b, &state) == PERI_OK);
            (void)scene_run(a, 40);
            (void)scene_run(b, 40);
            (void)scene_run(c, 40);
            (void)scene_run(many, 12);
            (void)scene_run(many, 40);
            CHECK(same_state(a, b) && same_state(a, c) && same_state(a, many));
            MUST(a, peri_get_energy(a, &e));
            CHECK(fabs(e.error) <= 0.15 * (e.kinetic + e.elastic + e.fracture + e.damping)); /* at 0.9 stable steps */
            broken += peri_broken_count(a);
            MUST(a, peri_reset(a));
            MUST(b, peri_reset(b));
            CHECK(peri_broken_count(a) == 0);
            (void)scene_run(a, 20);
            (void)scene_run(b, 20);
            CHECK(same_state(a, b));
            MUST(a, peri_set_no_fail(a, PERI_ALL, 1));
            const int64_t before = peri_broken_count(a);
            (void)scene_run(a, 20);
            CHECK(peri_broken_count(a) == before);
            free(state.data);
            peri_body_destroy(many);
            peri_body_destroy(c);
            peri_body_destroy(b);
            peri_body_destroy(a);
        }
        printf("    criterion %d: %d bonds broken\n", (int)criterion, (int)broken);
        CHECK(broken > 100);
    }
}

/* The ledger closes to the square of the step where bonds break within it: a quarter of a step that closes to 5 %. */
static void ledgers_close(void) {
    for (int32_t criterion = first_new(); criterion < peri__end_criterion; ++criterion)
        for (int32_t law = peri__first_law; law < peri__end_law; ++law) {
            const scene s = scene_of(law, criterion, PERI_PRECISION_DOUBLE, 0);
            peri_body *b = scene_make(&s);
            peri_advance_desc a;
            peri_energy e;
            peri_advance_desc_init(&a);
            a.steps = 320;
            a.time_step = 6.0 / 320;
            MUST(b, peri_advance(b, &a));
            MUST(b, peri_get_energy(b, &e));
            CHECK(peri_broken_count(b) > 30);
            CHECK(fabs(e.error) <= 0.05 / 16 * 1.5 * (e.kinetic + e.elastic + e.fracture));
            peri_body_destroy(b);
        }
}

/* Columns, list and rows break the same bonds of a body that is pulled apart; a notch decides which are first. */
static void kernels_agree(void) {
    static const int32_t kernels[3] = {PERI_KERNEL_BEST, PERI_KERNEL_LIST, PERI_KERNEL_REFERENCE};
    const double notch[2][2] = {{-1, 4.5}, {3.5, 4.5}};
    for (int32_t criterion = first_new(); criterion < peri__end_criterion; ++criterion)
        for (int32_t law = peri__first_law; law < peri__end_law; ++law) {
            double *damage[3];
            int64_t broken = 0;
            for (int k = 0; k < 3; ++k) {
                specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 3, 10, 9, 1);
                peri_advance_desc a;
                p.desc.kernel = kernels[k];
                give_criterion(&p.material, criterion, 0.02, 3, 2);
                peri_body *b = specimen_make(&p);
                MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, notch[0], notch[1]));
                double *x = get(b, PERI_FIELD_POSITION), *v = get(b, PERI_FIELD_VELOCITY);
                for (int64_t i = 0; i < peri_point_count(b); ++i) v[2 * i + 1] = 0.007 * (x[2 * i + 1] - 4.5) + 1e-5 * x[2 * i];
                put(b, PERI_FIELD_VELOCITY, v);
                peri_advance_desc_init(&a);
                a.steps = 12;
                a.time_step = 0.5;
                MUST(b, peri_advance(b, &a));
                damage[k] = get(b, PERI_FIELD_DAMAGE);
                broken = peri_broken_count(b);
                free(x);
                free(v);
                peri_body_destroy(b);
            }
            if (!(broken > 0)) printf("    criterion %d, law %d: none broke\n", (int)criterion, (int)law);
            CHECK(broken > 0);
            CHECK(memcmp(damage[0], damage[1], 90 * sizeof(double)) == 0 && memcmp(damage[0], damage[2], 90 * sizeof(double)) == 0);
            for (int k = 0; k < 3; ++k) free(damage[k]);
        }
}

/* Bytes of a box are those of its plan; a body that asks for nothing of this holds nothing of it. */
static void memory_is_planned(void) {
    int64_t plain[2] = {0, 0};
    for (int32_t criterion = PERI_CRITERION_STRETCH; criterion < peri__end_criterion; ++criterion)
        for (int solid = 0; solid < 2; ++solid) {
            specimen p = specimen_of(solid ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, 0.2, 1, 3, 12, 11, 6);
            pool memory = {0, 0, 0, 0, -1, 0};
            peri_memory m;
            hook(&p.desc, &memory);
            give_criterion(&p.material, criterion, 0.01, 3, 1);
            const peri_plan_report plan = specimen_plan(&p, 0);
            peri_body *b = specimen_make(&p);
            MUST(b, peri_get_memory(b, &m));
            CHECK(plan.bytes == m.total);
            const int64_t n = peri_point_count(b), words = (peri_family_width(b) + 31) / 32;
            if (criterion == PERI_CRITERION_STRETCH) plain[solid] = m.damage;
            if (criterion == PERI_CRITERION_RATE_STRETCH) CHECK(m.damage == plain[solid]);
            if (criterion == PERI_CRITERION_CONFINED_STRETCH)
                CHECK(m.damage - plain[solid] >= 8 * n && m.damage - plain[solid] < 8 * n + 200);
            if (criterion >= PERI_CRITERION_PRINCIPAL_STRESS && criterion <= PERI_CRITERION_MOHR_COULOMB) {
                const int64_t bytes = (8 * (solid ? 9 + 3 + 7 : 4 + 3 + 4) + 4 * words) * n;
                CHECK(m.damage - plain[solid] >= bytes && m.damage - plain[solid] < bytes + 500);
            }
            peri_body_destroy(b);
            CHECK(memory.blocks == 0 && memory.wrong == 0);
        }
}

/* Each allocation of a build fails once. */
static void allocations_fail(void) {
    for (int32_t criterion = first_new(); criterion < peri__end_criterion; ++criterion) {
        pool memory = {0, 0, 0, 0, -1, 0};
        int32_t built = PERI_ERROR_MEMORY;
        for (int64_t at = 0; at < 200 && built != PERI_OK; ++at) {
            const double hi[2] = {5, 4}, lo[2] = {0, 0};
            specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 2, 5, 4, 1);
            peri_body *b = NULL;
            hook(&p.desc, &memory);
            memory.fail_at = -1;
            give_criterion(&p.material, criterion, 0.01, 3, 1);
            MUST(NULL, peri_body_create(&p.desc, &b, NULL));
            MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &p.material)), lo, hi, 1));
            memory.calls = 0;
            memory.fail_at = at;
            built = peri_build(b);
            CHECK(built == PERI_OK || built == PERI_ERROR_MEMORY);
            peri_body_destroy(b);
            CHECK(memory.blocks == 0 && memory.wrong == 0);
        }
        CHECK(built == PERI_OK);
    }
}

/* ---- what is refused ---------------------------------------------------------------------------------------------- */

static void refused(int32_t law, int32_t criterion, int32_t code, const char *field, size_t place, double value) {
    specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 3, 5, 5, 1);
    peri_body *b = NULL;
    peri_error e;
    give_criterion(&p.material, criterion, 0.01, 3, 1);
    memcpy((char *)&p.material + place, &value, sizeof value);
    MUST(NULL, peri_body_create(&p.desc, &b, NULL));
    CHECK(peri_add_material(b, &p.material) == code);
    MUST(b, peri_get_error(b, &e));
    if (e.code != code || strcmp(e.field, field) != 0) printf("    criterion %d: %s, not %s\n", (int)criterion, e.field, field);
    CHECK(e.code == code && strcmp(e.field, field) == 0);
    CHECK(peri_id(b, PERI_KIND_MATERIAL, 1) < 0);
    peri_body_destroy(b);
}

#define REFUSED(criterion, code, member, value)                                                                        \
    refused(PERI_LAW_LPS, PERI_CRITERION_##criterion, PERI_ERROR_##code, #member, offsetof(peri_material_desc, member), value)

static void what_contradicts(void) {
    REFUSED(PRINCIPAL_STRESS, CRITERION, strength, 0); /* lacking */
    REFUSED(VON_MISES, CRITERION, strength, 0);
    REFUSED(MOHR_COULOMB, CRITERION, cohesion, 0);
    REFUSED(CONFINED_STRETCH, CRITERION, critical_stretch, 0);
    REFUSED(RATE_STRETCH, CRITERION, rate, 0);
    REFUSED(RATE_STRETCH, CRITERION, critical_stretch, 0);
    REFUSED(DELAYED_STRETCH, CRITERION, delay, 0);
    REFUSED(BOND_ENERGY, CRITERION, fracture_energy, 0);
    REFUSED(STRETCH, CRITERION, strength, 1); /* of another */
    REFUSED(STRETCH, CRITERION, cohesion, 1);
    REFUSED(STRETCH, CRITERION, friction_angle, 0.1);
    REFUSED(RATE_STRETCH, CRITERION, compression, 0.1);
    REFUSED(DELAYED_STRETCH, CRITERION, rate, 1);
    REFUSED(CONFINED_STRETCH, CRITERION, rate_power, 1);
    REFUSED(RATE_STRETCH, CRITERION, delay, 1);
    REFUSED(PRINCIPAL_STRESS, CRITERION, fracture_energy, 1);
    REFUSED(MOHR_COULOMB, CRITERION, critical_stretch, 1);
    REFUSED(VON_MISES, CRITERION, cohesion, 1);
    REFUSED(PRINCIPAL_STRESS, RANGE, strength, -1); /* no number of its kind */
    REFUSED(PRINCIPAL_STRESS, RANGE, strength, HUGE_VAL);
    REFUSED(MOHR_COULOMB, RANGE, friction_angle, 1.6);
    REFUSED(MOHR_COULOMB, RANGE, cohesion, (double)NAN);
    REFUSED(CONFINED_STRETCH, RANGE, compression, 1001);
    REFUSED(RATE_STRETCH, RANGE, rate_power, 11);
    REFUSED(RATE_STRETCH, RANGE, rate, -1);
    REFUSED(DELAYED_STRETCH, RANGE, delay, -1);
    refused(PERI_LAW_BOND_BASED, PERI_CRITERION_BOND_ENERGY, PERI_ERROR_CRITERION, "criterion", offsetof(peri_material_desc, strength), 0);
}

/* Cells that count by their centroids see each bond in two ways: stress and what is kept of bonds are refused there. */
static void centroids_are_refused(void) {
    for (int32_t criterion = first_new(); criterion < peri__end_criterion; ++criterion) {
        specimen p = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3, 5, 5, 1);
        peri_body *b = NULL;
        peri_error e;
        p.desc.quadrature = PERI_QUADRATURE_PARTIAL_CENTROID;
        give_criterion(&p.material, criterion, 0.01, 3, 1);
        MUST(NULL, peri_body_create(&p.desc, &b, NULL));
        CHECK(peri_add_material(b, &p.material) == PERI_ERROR_CRITERION);
        MUST(b, peri_get_error(b, &e));
        CHECK(strcmp(e.field, "quadrature") == 0);
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(copies_run_on);
    RUN(ledgers_close);
    RUN(kernels_agree);
    RUN(memory_is_planned);
    RUN(allocations_fail);
    RUN(what_contradicts);
    RUN(centroids_are_refused);
    return test_end("test_strengths_life");
}
