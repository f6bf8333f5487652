/* SPDX-License-Identifier: MIT */
/* test_states.c - what state-based bodies refuse, their fields, failing memory, and what each feature costs in bytes.

   SOURCE OF TRUTH: peri.h: the ranges of the fields, the names of the errors, "a call that fails has changed nothing", "keeps dim + 1
   numbers per bond". */
#include "failure.h"

/* ---- refusals ----------------------------------------------------------------------------------------------------- */

static peri_body *bare(int32_t space) {
    peri_body_desc d = plan(space);
    peri_body *b = NULL;
    (void)MUST(NULL, peri_body_create(&d, &b, NULL));
    return b;
}

/* The last call on b gave this error: code, and the field that it names. */
static void refused(peri_body *b, int64_t result, int32_t code, const char *field, int line) {
    peri_error e;
    (void)peri_get_error(b, &e);
    if (result == code && e.code == code && strcmp(e.field, field) == 0) return;
    test_bad++;
    printf("    line %d: returned %d, record %d \"%s\"; expected %d \"%s\"\n", line, (int)result, (int)e.code, e.field, (int)code, field);
}
#define REFUSED(b, call, code, field) refused((b), (int64_t)(call), (code), (field), __LINE__)

#define BAD(kind_, code, name, change)                                                                                 \
    do {                                                                                                               \
        peri_material_desc_init(&m, (kind_));                                                                               \
        m.young = YOUNG;                                                                                               \
        m.density = DENSITY;                                                                                           \
        m.poisson = (kind_) == PERI_LAW_BOND_BASED ? m.poisson : 0.2;                                                      \
        change;                                                                                                        \
        REFUSED(b, peri_add_material(b, &m), (code), (name));                                                          \
    } while (0)

static void materials_refused(void) {
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
        peri_body *b = bare(space);
        peri_material_desc m;
        for (law = PERI_LAW_LPS; law < peri__end_law; ++law) {
            BAD(law, PERI_ERROR_RANGE, "poisson", m.poisson = (double)NAN);
            BAD(law, PERI_ERROR_RANGE, "poisson", m.poisson = -1);
            BAD(law, PERI_ERROR_RANGE, "poisson", m.poisson = -1.5);
            BAD(law, PERI_ERROR_RANGE, "poisson", m.poisson = 0.5);
            BAD(law, PERI_ERROR_RANGE, "poisson", m.poisson = 0.6);
            BAD(law, PERI_ERROR_RANGE, "poisson", m.poisson = HUGE_VAL);
            BAD(law, PERI_ERROR_CHOICE, "criterion", m.criterion = 0);
            BAD(law, PERI_ERROR_CHOICE, "criterion", m.criterion = peri__end_criterion);
            BAD(law, PERI_ERROR_CRITERION, "fracture_energy", m.criterion = PERI_CRITERION_BOND_ENERGY);
            BAD(law, PERI_ERROR_CRITERION, "fracture_energy", m.criterion = PERI_CRITERION_NODE_ENERGY);
            BAD(law, PERI_ERROR_CRITERION, "fracture_energy", m.criterion = PERI_CRITERION_NODE_ENERGY; m.critical_stretch = 0.1);
            BAD(law, PERI_ERROR_RANGE, "stabilization", m.stabilization = -0.1);
            BAD(law, PERI_ERROR_RANGE, "stabilization", m.stabilization = (double)NAN);
            BAD(law, PERI_ERROR_RANGE, "stabilization", m.stabilization = HUGE_VAL);
            if (law != PERI_LAW_CORRESPONDENCE) BAD(law, PERI_ERROR_LAW, "stabilization", m.stabilization = 0.5);
        }
        BAD(PERI_LAW_BOND_BASED, PERI_ERROR_CRITERION, "criterion", m.criterion = PERI_CRITERION_BOND_ENERGY; m.fracture_energy = 1);
        BAD(PERI_LAW_BOND_BASED, PERI_ERROR_CRITERION, "criterion", m.criterion = PERI_CRITERION_NODE_ENERGY; m.fracture_energy = 1);
        BAD(PERI_LAW_BOND_BASED, PERI_ERROR_LAW, "stabilization", m.stabilization = 0.5);
        BAD(0, PERI_ERROR_CHOICE, "law", (void)0);
        BAD((int32_t)peri__end_law, PERI_ERROR_CHOICE, "law", (void)0);
        peri_material_desc_init(&m, PERI_LAW_CORRESPONDENCE); /* nothing above has taken an id; 0 stabilization is a choice */
        m.young = m.density = 1;
        m.poisson = -0.999;
        m.stabilization = 0;
        CHECK(PERI_ID_INDEX(MUST(b, peri_add_material(b, &m))) == 1);
        peri_body_destroy(b);
    }
    for (law = PERI_LAW_LPS; law < peri__end_law; ++law) {
        peri_material_desc m;
        peri_material_desc_init(&m, law);
        CHECK(m.criterion == PERI_CRITERION_STRETCH && m.poisson != m.poisson && m.fracture_energy == 0 && m.critical_stretch == 0);
        CHECK(m.stabilization == (law == PERI_LAW_CORRESPONDENCE ? 0.2 : 0));
    }
}

/* Partial centroids and moments are bond-based; interfaces are springs; corrections are four, and act on whole bonds to centres. */
static void combinations_refused(void) {
    int32_t law, q, c, id[4];
    for (law = PERI_LAW_LPS; law < peri__end_law; ++law) {
        kind k = kind_of(PERI_SPACE_PLANE_STRAIN, law, PERI_CRITERION_STRETCH, 0.2), bonds = k;
        peri_material_desc m = stuff(k), spring, other;
        peri_body *b;
        bonds.law = PERI_LAW_BOND_BASED;
        spring = other = stuff(bonds);
        for (q = PERI_QUADRATURE_FULL; q < peri__end_quadrature; ++q) {
            peri_body_desc d = plan(k.space);
            d.quadrature = q;
            (void)MUST(NULL, peri_body_create(&d, &b, NULL));
            if (q >= PERI_QUADRATURE_PARTIAL_CENTROID) REFUSED(b, peri_add_material(b, &m), PERI_ERROR_LAW, "quadrature");
            else (void)MUST(b, peri_add_material(b, &m));
            CHECK(PERI_ID_INDEX(MUST(b, peri_add_material(b, &spring))) == (q >= PERI_QUADRATURE_PARTIAL_CENTROID ? 1 : 2));
            peri_body_destroy(b);
        }
        b = bare(k.space);
        for (c = 0; c < 4; ++c) id[c] = (int32_t)MUST(b, peri_add_material(b, c % 2 ? &m : c == 0 ? &spring : &other));
        CHECK(peri_set_interface(b, id[0], id[1], &spring) == PERI_ERROR_LAW);
        CHECK(peri_set_interface(b, id[3], id[2], &spring) == PERI_ERROR_LAW);
        CHECK(peri_set_interface(b, id[1], id[3], &spring) == PERI_ERROR_LAW);
        CHECK(peri_set_interface(b, id[0], id[2], &m) == PERI_ERROR_LAW);
        CHECK(peri_set_interface(b, id[0], id[2], &spring) == PERI_OK);
        peri_body_destroy(b);
    }
    for (q = PERI_QUADRATURE_FULL; q < peri__end_quadrature; ++q)
        for (c = peri__first_correction - 2; c < peri__end_correction + 2; ++c) {
            peri_body_desc d = plan(PERI_SPACE_PLANE_STRESS);
            peri_body *b = NULL;
            peri_error e;
            int bad = c < PERI_CORRECTION_NONE || c >= peri__end_correction
                    || (q >= PERI_QUADRATURE_PARTIAL_CENTROID && c > PERI_CORRECTION_NONE);
            int32_t r;
            d.quadrature = q;
            d.correction = c;
            r = peri_body_create(&d, &b, &e);
            CHECK(r == (bad ? PERI_ERROR_CHOICE : PERI_OK) && e.code == r && (b == NULL) == (bad != 0));
            if (bad) CHECK(strcmp(e.field, "correction") == 0);
            peri_body_destroy(b);
        }
}

/* K = E/(3(1-2 nu)): a body of bulk modulus K moves as one of E does: to rounding of that formula. */
static void bulk_is_young(void) {
    int32_t space, law;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_LPS; law < peri__end_law; ++law) {
            const double lo[3] = {0, 0, 0}, hi[3] = {5 * H, 4 * H, 3 * H};
            double *f[2], *u = NULL, most;
            int64_t i, n = 0;
            int by;
            for (by = 0; by < 2; ++by) {
                peri_body *b = bare(space);
                peri_material_desc m = stuff(kind_of(space, law, PERI_CRITERION_STRETCH, 0.35));
                if (by) m.young = 0, m.bulk = YOUNG / (3 * (1 - 2 * 0.35));
                (void)MUST(b, peri_add_box(b, (int32_t)MUST(b, peri_add_material(b, &m)), lo, hi, H));
                (void)MUST(b, peri_build(b));
                n = peri_size_of_field(b, PERI_FIELD_FORCE_DENSITY);
                u = random_field(n, 0.03 * H, 1);
                put(b, PERI_FIELD_DISPLACEMENT, u);
                f[by] = get(b, PERI_FIELD_FORCE_DENSITY);
                free(u);
                peri_body_destroy(b);
            }
            most = largest(f[0], n);
            for (i = 0; i < n; ++i) CHECK_NEAR(f[1][i], f[0][i], 0, 1e-13 * most);
            CHECK(most > 0);
            free(f[0]);
            free(f[1]);
        }
}

static void constants_refused(void) {
    const int32_t poles[3] = {PERI_INFLUENCE_INVERSE_4, PERI_INFLUENCE_POLE_HALF, PERI_INFLUENCE_POLE_QUARTER};
    kind k = kind_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_LPS, PERI_CRITERION_BOND_ENERGY, 0.2);
    peri_body *b = bare(k.space);
    peri_material_desc m = stuff(k);
    double w0 = -1, c, s0;
    int32_t first, second;
    int n;
    REFUSED(b, peri_get_critical_energy(b, 0, &w0), PERI_ERROR_ID_NONE, "material");
    REFUSED(b, peri_id(b, PERI_KIND_MATERIAL, 1), PERI_ERROR_ID_GONE, "index");
    first = (int32_t)MUST(b, peri_add_material(b, &m));
    REFUSED(b, peri_get_critical_energy(b, first + 1, &w0), PERI_ERROR_ID_GONE, "material");
    REFUSED(b, peri_get_critical_energy(b, -1, &w0), PERI_ERROR_ID_NONE, "material");
    REFUSED(b, peri_get_critical_energy(b, 1, &w0), PERI_ERROR_ID_NONE, "material");
    REFUSED(b, peri_get_critical_energy(b, PERI_ALL, &w0), PERI_ERROR_ID_KIND, "material");
    REFUSED(b, peri_get_critical_energy(b, first, NULL), PERI_ERROR_ARGUMENT, "w0");
    CHECK(peri_get_critical_energy(NULL, first, &w0) == PERI_ERROR_ARGUMENT && w0 == -1);
    CHECK(peri_get_bond_constants(b, first, first, NULL, &s0) == PERI_OK && s0 == HUGE_VAL); /* its criterion is another */
    REFUSED(b, peri_get_bond_constants(b, first, first, &c, &s0), PERI_ERROR_LAW, "c");
    k.law = PERI_LAW_BOND_BASED;
    k.criterion = PERI_CRITERION_STRETCH;
    k.limit = CRITICAL;
    m = stuff(k);
    second = (int32_t)MUST(b, peri_add_material(b, &m));
    CHECK(peri_get_critical_energy(b, second, &w0) == PERI_OK && w0 == HUGE_VAL);
    CHECK(peri_get_bond_constants(b, first, second, &c, &s0) == PERI_ERROR_LAW);
    CHECK(peri_get_bond_constants(b, second, first, &c, &s0) == PERI_ERROR_LAW);
    CHECK(peri_get_bond_constants(b, second, second, &c, &s0) == PERI_OK && s0 == CRITICAL && c > 0);
    CHECK(peri_get_bond_constants(b, second, first, NULL, &s0) == PERI_OK && s0 == CRITICAL); /* the lower one */
    peri_body_destroy(b);
    for (n = 0; n < 3; ++n) { /* no moments: no critical stretch from G0; a given one is one */
        peri_body_desc d = plan(PERI_SPACE_PLANE_STRAIN);
        d.influence = poles[n];
        (void)MUST(NULL, peri_body_create(&d, &b, NULL));
        k.law = PERI_LAW_LPS;
        m = stuff(k);
        first = (int32_t)MUST(b, peri_add_material(b, &m));
        CHECK(peri_get_bond_constants(b, first, first, NULL, &s0) == PERI_OK && s0 == CRITICAL);
        m.critical_stretch = 0;
        m.fracture_energy = 1;
        second = (int32_t)MUST(b, peri_add_material(b, &m));
        REFUSED(b, peri_get_bond_constants(b, second, second, NULL, &s0), PERI_ERROR_INFLUENCE, "influence");
        peri_body_destroy(b);
    }
}

/* ---- fields ------------------------------------------------------------------------------------------------------- */

static int parts_of(int32_t field, int dim) {
    if (field >= PERI_FIELD_STRAIN && field <= PERI_FIELD_FORCE_STRESS) return dim == 3 ? 6 : 3;
    if (field == PERI_FIELD_DEFORMATION_GRADIENT) return dim * dim;
    return field == PERI_FIELD_REACTION || field == PERI_FIELD_HELD ? dim : 1;
}
typedef struct reader {
    int reads, failed;
} reader;
static int32_t read_fields(reader *r, peri_body *b) {
    int32_t field;
    for (field = PERI_FIELD_DILATATION; field < peri__end_field; ++field) {
        double out[1000];
        peri_view v;
        int64_t i, n = peri_size_of_field(b, field);
        r->failed += n > 1000 || peri_get_field(b, field, out, 1000) != PERI_OK || peri_view_field(b, field, &v) != PERI_OK;
        for (i = 0; i < n; ++i) r->failed += !(fabs(out[i]) < 1e9);
    }
    r->reads++;
    return 0;
}
static int32_t frame_reads(void *user, peri_body *b) { return read_fields((reader *)user, b); }
typedef struct load_reader {
    reader     r;
    peri_body *b;
} load_reader;
static int32_t load_reads(void *user, double time, int64_t count, const int32_t *points, double *value) {
    load_reader *l = (load_reader *)user;
    (void)time, (void)count, (void)points, (void)value;
    (void)read_fields(&l->r, l->b);
    return 0;
}

static void new_fields(void) {
    int32_t space, law, field;
    for (space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            const int dim = dim_of(space);
            kind k = kind_of(space, law, PERI_CRITERION_STRETCH, law == PERI_LAW_BOND_BASED ? (double)NAN : 0.2);
            peri_body *b = box(k, PERI_GEOMETRY_NONLINEAR, 5, 4, 3);
            const int64_t n = peri_point_count(b);
            double *u = random_field(n * dim, 0.001 * H, 2), value[3] = {0, 0, 0};
            load_reader l;
            peri_advance_desc r;
            memset(&l, 0, sizeof l);
            l.b = b;
            put(b, PERI_FIELD_DISPLACEMENT, u);
            (void)MUST(b, peri_prescribe_velocity(b, slab(b, 0, H), PERI_AXIS_X, NULL, NULL, NULL));
            (void)MUST(b, peri_apply_body_force(b, PERI_ALL, value, load_reads, &l));
            peri_advance_desc_init(&r);
            r.steps = 4;
            r.frame_steps = 2;
            r.on_frame = frame_reads;
            r.user = &l.r;
            (void)MUST(b, peri_advance(b, &r));
            CHECK(l.r.reads >= 6 && l.r.failed == 0);
            for (field = PERI_FIELD_DILATATION; field < peri__end_field; ++field) {
                const int parts = parts_of(field, dim);
                const int64_t need = n * parts;
                double *out = (double *)calloc((size_t)need + 1, sizeof *out);
                int64_t i;
                peri_view v;
                peri_error e;
                int d;
                CHECK(peri_size_of_field(b, field) == need);
                out[0] = 77;
                REFUSED(b, peri_get_field(b, field, out, need - 1), PERI_ERROR_CAPACITY, "capacity");
                CHECK(peri_get_error(b, &e) == PERI_OK && e.value == (double)need && out[0] == 77);
                REFUSED(b, peri_get_field(b, field, NULL, need), PERI_ERROR_ARGUMENT, "out");
                const int fixed = field != PERI_FIELD_DENSITY && (field < PERI_FIELD_EIGENSTRAIN || field > PERI_FIELD_STIFFNESS);
                if (fixed) /* the others: test_point_fields */
                    REFUSED(b, peri_set_field(b, field, u, need), PERI_ERROR_FIELD, "field");
                REFUSED(b, peri_view_field(b, field, NULL), PERI_ERROR_ARGUMENT, "view");
                out[need] = 77;
                (void)MUST(b, peri_get_field(b, field, out, need));
                (void)MUST(b, peri_view_field(b, field, &v));
                CHECK(out[need] == 77 && v.count == n && v.components == parts && v.type == PERI_TYPE_F64);
                for (i = 0; i < n; ++i)
                    for (d = 0; d < parts; ++d) {
                        const double *data = (const double *)v.data;
                        CHECK(v.offset[d % 3] + v.scale * data[i * v.point_stride + d * v.component_stride] == out[i * parts + d]);
                    }
                free(out);
            }
            REFUSED(b, peri_get_field(b, peri__end_field, u, 1000), PERI_ERROR_CHOICE, "field");
            CHECK(peri_size_of_field(b, peri__end_field) == PERI_ERROR_CHOICE && peri_size_of_field(b, 0) == PERI_ERROR_CHOICE);
            free(u);
            peri_body_destroy(b);
        }
}

/* ---- failing memory ----------------------------------------------------------------------------------------------- */

static int32_t told(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)i, (void)j, (void)time, (void)stretch;
    ++*(int *)user;
    return 0;
}

typedef struct life {
    peri_body *body, *copy;
    kind       what;
    int        breaks, precision;
    double     sum; /* of all that was read */
} life;

#define STEPS 14
static int64_t live(life *l, pool *p, int step) {
    const double lo[3] = {0, 0, 0}, hi[3] = {7 * H, 5 * H, 3 * H}, a[3] = {0.35, 0, 0}, z[3] = {0.35, 0.2, 0.3}, n[3] = {1, 0, 0};
    const double left[3] = {-0.06, 0, 0}, right[3] = {0.06, 0, 0};
    const int dim = dim_of(l->what.space);
    peri_body_desc d = plan(l->what.space);
    peri_material_desc m = stuff(l->what);
    peri_advance_desc r;
    peri_advance_desc_init(&r);
    r.steps = 30;
    r.time_step = 0.02;
    r.force_step = 1;
    switch (step) {
    case 0:
        d.horizon = 2.2 * H;
        d.correction = l->what.law == PERI_LAW_OTERKUS ? PERI_CORRECTION_ENERGY : PERI_CORRECTION_MOMENT;
        d.quadrature = l->what.law == PERI_LAW_OTERKUS ? PERI_QUADRATURE_PARTIAL : PERI_QUADRATURE_FULL;
        d.precision = l->precision;
        hook(&d, p);
        return peri_body_create(&d, &l->body, NULL);
    case 1: return peri_add_material(l->body, &m);
    case 2: return peri_add_box(l->body, peri_id(l->body, PERI_KIND_MATERIAL, 1), lo, hi, H);
    case 3: return peri_build(l->body);
    case 4: return dim == 2 ? peri_cut_segment(l->body, PERI_CUT_INITIAL, a, z) : peri_cut_disc(l->body, PERI_CUT_INITIAL, a, n, 0.2);
    case 5: return peri_on_break(l->body, told, &l->breaks);
    case 6: return peri_select_box(l->body, "left", lo, z);
    case 7: return peri_prescribe_velocity(l->body, peri_id(l->body, PERI_KIND_SET, 1), PERI_AXIS_X, left, NULL, NULL);
    case 8: return peri_add_velocity(l->body, PERI_ALL, right);
    case 9: return peri_advance(l->body, &r);
    case 10: {
        int32_t field;
        double sum = 0;
        for (field = PERI_FIELD_POSITION; field < peri__end_field; ++field) {
            peri_view v;
            int64_t i, size = peri_size_of_field(l->body, field);
            double *x = (double *)calloc((size_t)size, sizeof *x);
            int32_t status = peri_get_field(l->body, field, x, size);
            for (i = 0; status >= 0 && i < size; ++i) sum += x[i] * (double)(1 + i % 13);
            free(x);
            if (status >= 0) status = peri_view_field(l->body, field, &v);
            if (status < 0) return status;
        }
        l->sum += sum;
        return PERI_OK;
    }
    case 11: return peri_body_clone(l->body, &l->copy, NULL);
    case 12: return peri_advance(l->copy, &r);
    default: return peri_advance(l->body, &r);
    }
}
static int64_t whole_life(life *l, pool *p) {
    int step;
    for (step = 0; step < STEPS; ++step) {
        int64_t before = p->calls, r = live(l, p, step);
        if (p->fail_at >= before && p->fail_at < p->calls) {
            peri_error e;
            if (r != PERI_ERROR_MEMORY) printf("    allocation %d failed in step %d, which gave %d\n", (int)p->fail_at, step, (int)r);
            CHECK(r == PERI_ERROR_MEMORY);
            if (step == 0) CHECK(l->body == NULL);
            else if (step == 11) CHECK(l->copy == NULL);
            else CHECK(peri_get_error(l->body, &e) == PERI_OK && e.code == PERI_ERROR_MEMORY && e.field[0] != 0);
            r = live(l, p, step);
        }
        if (r < 0) printf("    step %d gave %d\n", step, (int)r);
        CHECK(r >= 0);
        if (r < 0) break;
    }
    return p->calls;
}
/* A failed call is made again at once, with memory: the life must end in the same bits, and leave no byte behind. */
static void fail_each(kind what, int precision) {
    pool calm = {0, 0, 0, 0, -1, 0};
    life first, l;
    int64_t total, n;
    double *u, *v;
    memset(&first, 0, sizeof first);
    first.what = what;
    first.precision = precision;
    total = whole_life(&first, &calm);
    CHECK(first.breaks > 0 && first.sum == first.sum && total > 40);
    for (n = 0; n < total && test_bad < 10; ++n) {
        pool p = {0, 0, 0, 0, 0, 0};
        p.fail_at = n;
        memset(&l, 0, sizeof l);
        l.what = what;
        l.precision = precision;
        (void)whole_life(&l, &p);
        CHECK(p.calls > n && l.sum == first.sum && l.breaks == first.breaks);
        u = get(first.body, PERI_FIELD_DISPLACEMENT);
        v = get(l.body, PERI_FIELD_DISPLACEMENT);
        CHECK(memcmp(u, v, (size_t)peri_size_of_field(l.body, PERI_FIELD_DISPLACEMENT) * sizeof *u) == 0);
        free(v);
        v = get(l.copy, PERI_FIELD_DISPLACEMENT);
        CHECK(memcmp(u, v, (size_t)peri_size_of_field(l.copy, PERI_FIELD_DISPLACEMENT) * sizeof *u) == 0);
        free(u);
        free(v);
        peri_body_destroy(n % 2 ? l.body : l.copy);
        peri_body_destroy(n % 2 ? l.copy : l.body);
        CHECK(p.blocks == 0 && p.bytes == 0 && p.wrong == 0);
    }
    printf("    %dD %-8s %s: %d allocations, each failed once\n", dim_of(what.space), law_name[what.law % 100],
           criterion_name[what.criterion % 100], (int)total);
    peri_body_destroy(first.body);
    peri_body_destroy(first.copy);
    CHECK(calm.blocks == 0 && calm.bytes == 0 && calm.wrong == 0);
}
static void every_allocation_fails_once(void) {
    fail_each(kind_of(PERI_SPACE_PLANE_STRAIN, PERI_LAW_CORRESPONDENCE, PERI_CRITERION_BOND_ENERGY, 0.3), PERI_PRECISION_DOUBLE);
    fail_each(kind_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, PERI_CRITERION_NODE_ENERGY, 0.2), PERI_PRECISION_SINGLE);
    if (test_long) fail_each(kind_of(PERI_SPACE_SOLID, PERI_LAW_OTERKUS, PERI_CRITERION_STRETCH, 0.3), PERI_PRECISION_DOUBLE);
}

/* ---- bytes -------------------------------------------------------------------------------------------------------- */

static double bytes_of(kind k, int32_t precision, double ratio, int side, double *entries, double *bonds) {
    pool p = {0, 0, 0, 0, -1, 0};
    peri_body_desc d = plan(k.space);
    peri_body *b;
    double bytes;
    d.horizon = ratio * H;
    d.precision = precision;
    hook(&d, &p);
    b = make(&d, k, side, side, side);
    bytes = (double)p.bytes;
    *entries = (double)peri_point_count(b) * peri_family_width(b);
    *bonds = (double)peri_entry_count(b);
    peri_body_destroy(b);
    CHECK(p.blocks == 0 && p.bytes == 0 && p.wrong == 0);
    return bytes;
}

/* SOURCE OF TRUTH: what a feature needs, counted: from two horizons over the same points, bytes per entry of the N x M family array and
   per point. State-based laws: no array per bond that a bond-based body without breaking has not (the smallest would be a bit, 0.125;
   margins of vectors per point grow a little with the horizon). Breaking: a bit per bond that says live, one for those that die, one
   where families are packed by columns; words of 32 round up. Bond energy: dim + 1 reals per bond, in columns of 16 of which a box of 40
   or 14 points a side fills two thirds and more. */
static void bytes_by_feature(void) {
    const char *const names[6] = {"bond-based", "LPS at 1/4", "LPS", "LPS, stretch", "LPS, bond energy", "correspondence"};
    int32_t space, precision;
    int n;
    for (space = PERI_SPACE_PLANE_STRAIN; space < peri__end_space; ++space)
        for (precision = PERI_PRECISION_DOUBLE; precision <= PERI_PRECISION_SINGLE; precision += 2) {
            const int side = space == PERI_SPACE_SOLID ? 14 : 40, dim = dim_of(space);
            const double near_ = space == PERI_SPACE_SOLID ? 3 : 6, far_ = space == PERI_SPACE_SOLID ? 4 : 9;
            const double real = precision == PERI_PRECISION_DOUBLE ? 8 : 4;
            double base[2] = {0, 0}, plain[2] = {0, 0}, entries[2], bonds[2], points = pow(side, dim);
            for (n = 0; n < 6; ++n) {
                kind k = kind_of(space, n == 0 ? PERI_LAW_BOND_BASED : n == 5 ? PERI_LAW_CORRESPONDENCE : PERI_LAW_LPS,
                                 n == 4 ? PERI_CRITERION_BOND_ENERGY : PERI_CRITERION_STRETCH, n == 1 ? 0.25 : 0.3);
                double bytes[2], per_bond, per_point, more;
                if (n != 3 && n != 4) k.limit = 0;
                bytes[0] = bytes_of(k, precision, near_, side, &entries[0], &bonds[0]);
                bytes[1] = bytes_of(k, precision, far_, side, &entries[1], &bonds[1]);
                if (n == 0 || n == 2) memcpy(n ? plain : base, bytes, sizeof base);
                per_bond = ((bytes[1] - base[1]) - (bytes[0] - base[0])) / (entries[1] - entries[0]);
                per_point = (bytes[0] - base[0] - per_bond * entries[0]) / points;
                if (test_long)
                    printf("    %dD %s %-17s %7.1f bytes/point at horizon %g H; beyond bond-based %6.3f per bond, %6.1f per point\n", dim,
                           precision == PERI_PRECISION_DOUBLE ? "double" : "float ", names[n], bytes[0] / points, near_, per_bond,
                           per_point);
                more = ((bytes[1] - plain[1]) - (bytes[0] - plain[0])) / (n == 4 ? bonds[1] - bonds[0] : entries[1] - entries[0]);
                if (n == 1 || n == 2 || n == 5) CHECK(per_bond <= 0.05);
                if (n == 3) CHECK(more > 0.2 && more <= 0.5);
                if (n == 4) CHECK(more > (dim + 1) * real && more <= 1.5 * (dim + 1) * real + 0.5);
            }
        }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(materials_refused);
    RUN(combinations_refused);
    RUN(bulk_is_young);
    RUN(constants_refused);
    RUN(new_fields);
    RUN(every_allocation_fails_once);
    RUN(bytes_by_feature);
    return test_end("test_states");
}
