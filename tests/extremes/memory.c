/* SPDX-License-Identifier: MIT */
/* memory.c - memory that runs out at each allocation, and memory of any alignment: statics, matrices, clones and plans, of every law. */
#include "scenes.h"

/* One call of a life, from the solve on; what it makes goes into the hash. */
enum { LIFE = 8 };
static int64_t live(peri_body *b, int call, int32_t way, uint64_t *hash) {
    const double lo[3] = {0, 0, 0}, hi[3] = {9, 2, 3}, down[3] = {0, -1, 0}, shear[3] = {1e-4, 0, 0};
    peri_solve_desc s;
    peri_advance_desc r;
    peri_matrix *matrix = NULL;
    peri_body *copy = NULL;
    int64_t status, n = peri_size_of_field(b, PERI_FIELD_DISPLACEMENT);
    double *x = (double *)malloc((size_t)n * 3 * sizeof *x);
    peri_solve_desc_init(&s);
    s.method = way == 3 ? PERI_METHOD_BICGSTAB : way == 4 ? PERI_METHOD_RELAXATION : PERI_METHOD_NEWTON;
    s.preconditioner = way < 3 ? PERI_PRECONDITIONER_MULTILEVEL + way : PERI_PRECONDITIONER_MULTILEVEL;
    s.tolerance = 1e-3;
    s.loose = PERI_LOOSE_BALANCED;
    s.load_to = 0.5;
    peri_advance_desc_init(&r);
    r.steps = 3;
    r.damping = 0.01;
    switch (call) {
    case 0: status = peri_solve(b, &s, NULL); break;
    case 1:
        status = peri_matrix_create(b, &matrix);
        if (status >= 0) status = peri_export_matrix_to(matrix, scene_swallow, hash);
        peri_matrix_destroy(matrix);
        break;
    case 2: status = peri_export_vtu_to(b, scene_swallow, hash); break;
    case 3:
        status = peri_body_clone(b, &copy, NULL);
        if (status >= 0) status = peri_advance(copy, &r);
        if (status >= 0) status = peri_get_field(copy, PERI_FIELD_VELOCITY, x, n);
        if (status >= 0) scene_digest(hash, x, n);
        peri_body_destroy(copy);
        break;
    case 4: status = peri_select_box(b, NULL, lo, hi); break;
    case 5: status = peri_apply_traction(b, peri_id(b, PERI_KIND_SET, 2), peri_dimension(b) == 3 ? 27 : 9, down, shear, NULL, NULL); break;
    case 6: status = peri_advance(b, &r); break;
    default:
        for (int64_t k = 0; k < n; ++k) x[k] = (double)(k % 7) * 1e-3;
        status = peri_multiply_stiffness(b, x, x, n);
        if (status >= 0) scene_digest(hash, x, n);
        if (status >= 0) status = peri_get_field(b, PERI_FIELD_DISPLACEMENT, x, n);
        if (status >= 0) scene_digest(hash, x, n);
        break;
    }
    free(x);
    return status;
}

/* The life of a body, each call made again where it fails for want of memory. Returns the allocations of its calls, after the build. */
static int64_t whole_life(outcome *o, int32_t law, int32_t precision, int32_t space, int32_t way, int64_t fail_at,
                          uint64_t *hash) {
    peri_body *b = scene_plate(o, law, precision, space);
    const int64_t from = extreme_memory.calls;
    int64_t calls, failed = 0;
    *hash = DIGEST_START;
    if (fail_at > 0) extreme_memory.fail_at = from + fail_at;
    for (int call = 0; call < LIFE && o->status >= 0; ++call) {
        const uint64_t before = *hash;
        const int64_t blocks = extreme_memory.blocks;
        int64_t status = live(b, call, way, hash);
        if (status == PERI_ERROR_MEMORY) {
            failed++;
            if (extreme_memory.blocks > blocks + 1) *o = scene_spoiled(*o, "memory kept by a call that failed");
            *hash = before;
            status = live(b, call, way, hash);
        }
        (void)extreme_fails(o, b, status);
    }
    calls = extreme_memory.calls - from;
    if (fail_at > 0 && failed != 1) *o = scene_spoiled(*o, "an allocation that failed and was not told");
    extreme_memory.fail_at = 0;
    *o = extreme_end(*o, b);
    return calls;
}

/* Each of the allocations, a third of them in each precision, since the calls are the same; in 3D one of twelve, by law and precision. */
static outcome fails_once(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    const int64_t third = precision == PERI_PRECISION_DOUBLE ? 1 : precision == PERI_PRECISION_MIXED ? 2 : 3;
    for (int k = 0; k < 4; ++k) {
        uint64_t whole, hash;
        const int32_t space = (int32_t)row->other;
        const int64_t calls = whole_life(&o, scene_laws[k], precision, space, row->choice, 0, &whole);
        const int64_t first = space == PERI_SPACE_SOLID ? third + 3 * k : third;
        HOLDS(calls > 20);
        for (int64_t at = first; at <= calls && o.status >= 0; at += space == PERI_SPACE_SOLID ? 12 : 3) {
            (void)whole_life(&o, scene_laws[k], precision, space, row->choice, at, &hash);
            HOLDS(hash == whole);
        }
    }
    return o;
}

static outcome any_alignment(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    (void)row;
    for (int k = 0; k < 4; ++k) {
        uint64_t whole, hash;
        extreme_memory.offset = 0;
        (void)whole_life(&o, scene_laws[k], precision, PERI_SPACE_SOLID - k % 2, k, 0, &whole);
        for (extreme_memory.offset = 1; extreme_memory.offset < 16 && o.status >= 0; extreme_memory.offset += 2) {
            (void)whole_life(&o, scene_laws[k], precision, PERI_SPACE_SOLID - k % 2, k, 0, &hash);
            HOLDS(hash == whole);
        }
    }
    return o;
}

/* A measured plan, each of its allocations failing once: the status says so, the report is empty, and nothing is left. */
static outcome plan_fails_once(const extreme *row, int32_t precision) {
    outcome o = {PERI_OK, "", 0};
    peri_body_desc d;
    peri_material_desc m;
    peri_plan_desc plan;
    peri_plan_report report;
    int64_t calls = 1;
    for (int64_t at = 0; at <= calls && o.status >= 0; at += at < 40 ? 1 : 7) {
        extreme_desc(&d, PERI_SPACE_PLANE_STRESS, precision, 2.2);
        extreme_material(&m, row->choice, 0.2, 0.01);
        peri_plan_desc_init(&plan);
        plan.body = &d;
        plan.material = &m;
        plan.source = row->choice == PERI_LAW_LPS ? PERI_SOURCE_POINTS : PERI_SOURCE_BOX;
        plan.spacing = 1;
        plan.hi[0] = 12;
        plan.hi[1] = 8;
        plan.measure = 1;
        extreme_memory.calls = 0;
        extreme_memory.fail_at = at;
        const int32_t status = peri_plan(&plan, &report, NULL);
        if (at == 0) {
            calls = extreme_memory.calls;
            HOLDS(status == PERI_OK && report.points == 96 && report.seconds > 0 && calls > 10);
        } else
            HOLDS(status == PERI_ERROR_MEMORY && report.points == 0 && report.seconds == 0);
        HOLDS(extreme_memory.blocks == 0 && extreme_memory.bytes == 0);
    }
    return o;
}

static const extreme rows[] = {
    {"each allocation fails once, multilevel, 2D", "peri.h: PERI_ERROR_MEMORY, nothing changed: the call made again gives the same bits",
     fails_once, 0, PERI_SPACE_PLANE_STRAIN, 0, PERI_OK, NULL, {0, 0, 0}},
    {"each allocation fails once, multilevel, 3D", "the same", fails_once, 0, PERI_SPACE_SOLID, 0, PERI_OK, NULL, {0, 0, 0}},
    {"each allocation fails once, block Jacobi, 2D", "the same", fails_once, 0, PERI_SPACE_PLANE_STRESS, 1, PERI_OK, NULL, {0, 0, 0}},
    {"each allocation fails once, BiCGSTAB, 2D", "the same", fails_once, 0, PERI_SPACE_PLANE_STRAIN, 3, PERI_OK, NULL, {0, 0, 0}},
    {"each allocation fails once, relaxation, 2D", "the same", fails_once, 0, PERI_SPACE_PLANE_STRESS, 4, PERI_OK, NULL, {0, 0, 0}},
    {"memory at odd addresses", "peri.h: any alignment will do; the same bits", any_alignment, 0, 0, 0, PERI_OK, NULL, {0, 0, 0}},
    {"each allocation of a measured plan fails once", "peri.h: the report is then all zero", plan_fails_once, 0, 0, PERI_LAW_BOND_BASED,
     PERI_OK, NULL, {0, 0, 0}},
    {"each allocation of a measured plan fails once, LPS", "the same", plan_fails_once, 0, 0, PERI_LAW_LPS, PERI_OK, NULL, {0, 0, 0}},
};
const extreme_table extreme_allocation = EXTREME_TABLE("memory", rows);
