/* SPDX-License-Identifier: MIT */
/* test_plan.c - what a body holds, by purpose, and what a scene will cost before it is made.

   SOURCE OF TRUTH: for bytes, an allocator that counts what is asked of it: peri_get_memory must agree to the byte at every stage of a
   life, peri_plan to what peri.h promises. For bonds of a lattice, the built body; for bodies too large to build, brute force over lattice
   vectors in long double, prod(n_d - |v_d|) each. For the stable step, peri_stable_step of the built body, and 2/sqrt(lambda) with
   lambda = 2 sum c V/|xi|/rho of a whole family written out. For the time of a step, orders of magnitude, and proportion to the points. */
#include "scene.h"

typedef struct pool {
    int64_t live, most, calls, fail_at;
} pool;

static void *pool_allocate(void *user, uint64_t bytes) {
    pool *p = (pool *)user;
    void *made = p->calls++ == p->fail_at ? NULL : malloc((size_t)bytes);
    if (!made) return NULL;
    p->live += (int64_t)bytes;
    if (p->live > p->most) p->most = p->live;
    return made;
}
static void pool_release(void *user, void *pointer, uint64_t bytes) {
    if (pointer) ((pool *)user)->live -= (int64_t)bytes;
    free(pointer);
}

/* ---- a scene, by plan and by deed --------------------------------------------------------------------------------- */

typedef struct scene {
    peri_body_desc desc;
    peri_material_desc  material;
    peri_plan_desc plan;
    pool           memory;
    peri_body     *body;
} scene;

static const int32_t nothing = -1;

/* A box of nx x ny (x nz) cells, 1 x `aspect` x 1 each, of which the horizon is m long; law LPS and above at Poisson's ratio 0.2. */
static void set_scene(scene *s, int32_t space, double m, int32_t law, int nx, int ny, int nz, double aspect) {
    const double n[3] = {nx, ny * aspect, nz};
    int d;
    memset(s, 0, sizeof *s);
    s->memory.fail_at = nothing;
    peri_body_desc_init(&s->desc);
    s->desc.space = space;
    s->desc.horizon = m;
    s->desc.threads = 1;
    s->desc.allocate = pool_allocate;
    s->desc.release = pool_release;
    s->desc.memory_user = &s->memory;
    peri_material_desc_init(&s->material, law);
    s->material.young = 3;
    s->material.density = 2;
    if (law != PERI_LAW_BOND_BASED) s->material.poisson = 0.2;
    peri_plan_desc_init(&s->plan);
    s->plan.body = &s->desc;
    s->plan.material = &s->material;
    s->plan.spacing = 1;
    for (d = 0; d < 3; ++d) s->plan.hi[d] = n[d];
}

/* Points anywhere in the box, of its mean volume. */
static void scatter(scene *s, int64_t count, int dim) {
    double *x = (double *)malloc((size_t)(count * dim) * sizeof *x), *v = (double *)malloc((size_t)count * sizeof *v), volume = 1;
    uint64_t seed = 5;
    int64_t k;
    int d;
    for (d = 0; d < dim; ++d) volume *= s->plan.hi[d];
    for (k = 0; k < count * dim; ++k) x[k] = test_random(&seed) * s->plan.hi[k % dim];
    for (k = 0; k < count; ++k) v[k] = volume / (double)count;
    (void)MUST(s->body, peri_add_points(s->body, count, x, v, NULL));
    free(x);
    free(v);
}

static void build(scene *s) {
    const int dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2;
    int32_t material;
    (void)MUST(NULL, peri_body_create(&s->desc, &s->body, NULL));
    material = (int32_t)MUST(s->body, peri_add_material(s->body, &s->material));
    if (s->plan.source == PERI_SOURCE_BOX) (void)MUST(s->body, peri_add_box(s->body, material, s->plan.lo, s->plan.hi, 1));
    else if (s->plan.source == PERI_SOURCE_PERTURBED)
        (void)MUST(s->body, peri_add_perturbed_box(s->body, material, s->plan.lo, s->plan.hi, 1, s->plan.amount, 3));
    else scatter(s, (int64_t)(s->plan.hi[0] * s->plan.hi[1] * (dim == 3 ? s->plan.hi[2] : 1) + 0.5), dim);
    (void)MUST(s->body, peri_build(s->body));
}

/* Can its bonds break? */
static int breakable(const scene *s) { return s->material.critical_stretch > 0 || s->material.fracture_energy > 0; }

/* Plans without a single call of the allocator, then builds and compares. Tolerances are those of peri.h: the step of a box to 5 %. Where
   state-based bonds can break it is the bound, of points that see the same faces: exact. */
static void compare(scene *s, const char *what, int exact) {
    peri_plan_report r;
    peri_error error;
    const int bad = test_bad;
    if (peri_plan(&s->plan, &r, &error) != PERI_OK) {
        test_bad++;
        printf("    %s: %s\n", error.text, error.field);
    }
    CHECK(s->memory.calls == 0);
    CHECK(r.seconds == 0);
    build(s);
    CHECK(r.points == peri_point_count(s->body));
    CHECK_NEAR(r.entries, peri_entry_count(s->body), exact ? 0 : 0.05, 0);
    if (exact) CHECK(r.width == peri_family_width(s->body));
    CHECK_NEAR(r.bytes, s->memory.live, exact ? 0 : 0.05, 0);
    CHECK_NEAR(r.peak, s->memory.most, exact ? 0.03 : 0.05, exact ? 0 : 5e5);
    if (exact && s->material.law != PERI_LAW_BOND_BASED && breakable(s))
        CHECK_NEAR(r.stable_step, peri_stable_step(s->body), s->desc.precision == PERI_PRECISION_SINGLE ? 1e-4 : 1e-8, 0);
    else if (exact) CHECK_NEAR(r.stable_step, peri_stable_step(s->body), 0.05, 0);
    if (test_bad != bad)
        printf("    %s, space %d, m %g, law %d, precision %d, quadrature %d: bytes %+.2f %%, peak %+.2f %%\n", what, s->desc.space,
               s->desc.horizon, s->material.law, s->desc.precision, s->desc.quadrature,
               100 * ((double)r.bytes / (double)s->memory.live - 1), 100 * ((double)r.peak / (double)s->memory.most - 1));
    peri_body_destroy(s->body);
    CHECK(s->memory.live == 0);
}

static const int boxes[][3] = {{64, 48, 12}, {33, 19, 9}, {26, 17, 8}, {17, 30, 5}, {5, 20, 16}, {7, 11, 9}, {1, 90, 2}};
#define BOXES ((int)(sizeof boxes / sizeof boxes[0]))

/* Box lattices are counted to the byte and to the column: rows that are and are not whole groups, thinner than a horizon, all laws. */
static void lattices_are_planned_exactly(void) {
    int k, law;
    for (k = 0; k < BOXES; ++k)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            scene s;
            int32_t space = (k + law) % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
            if (k == 0 && space == PERI_SPACE_SOLID && !test_long) continue; /* the largest */
            if (boxes[k][0] == 1 && (law != PERI_LAW_BOND_BASED)) continue; /* a line of points: no shear to calibrate on */
            set_scene(&s, space, 3, law, boxes[k][0], boxes[k][1], boxes[k][2], 1);
            s.desc.precision = k % 2 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
            if (k % 3) s.material.critical_stretch = 0.1;
            compare(&s, "lattice", 1);
        }
}

/* The rules of quadrature reach further, cells that are no squares see it; influence functions weigh the step. */
static void quadratures_and_influences_are_planned_exactly(void) {
    int k, rule;
    for (k = 0; k < BOXES - 1; ++k)
        for (rule = PERI_QUADRATURE_FULL; rule < peri__end_quadrature; ++rule) {
            scene s;
            const int32_t space = rule <= PERI_QUADRATURE_PARTIAL && k % 2 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN;
            set_scene(&s, space, 2.3, PERI_LAW_BOND_BASED, boxes[k][0], boxes[k][1], boxes[k][2] / 2 + 2, 1.15);
            s.desc.quadrature = rule;
            s.desc.influence = k % 2 ? PERI_INFLUENCE_GAUSSIAN : PERI_INFLUENCE_LINEAR;
            s.material.fracture_energy = 1;
            compare(&s, "quadrature", 1);
        }
}

/* What keeps the list, and more of it: energy criteria, textbook kernels, moment correction of state-based laws, families above 1024. */
static void lists_are_planned_exactly(void) {
    scene s;
    set_scene(&s, PERI_SPACE_SOLID, 3, PERI_LAW_LPS, 20, 15, 9, 1);
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    s.material.fracture_energy = 1;
    compare(&s, "bond energy", 1);
    set_scene(&s, PERI_SPACE_PLANE_STRESS, 3, PERI_LAW_CORRESPONDENCE, 40, 35, 1, 1);
    s.material.criterion = PERI_CRITERION_NODE_ENERGY;
    s.material.fracture_energy = 1;
    compare(&s, "node energy", 1);
    set_scene(&s, PERI_SPACE_PLANE_STRESS, 3, PERI_LAW_BOND_BASED, 40, 35, 1, 1);
    s.desc.kernel = PERI_KERNEL_REFERENCE;
    compare(&s, "textbook", 1);
    set_scene(&s, PERI_SPACE_PLANE_STRESS, 3, PERI_LAW_BOND_BASED, 9, 7, 1, 1); /* columns would be too empty */
    compare(&s, "small", 1);
}

/* Corrections: bytes to 5 %, whatever becomes of the families. Above the limits of the exact step the coarser one is within 5 %. */
static void corrections_and_large_families_are_planned(void) {
    int correction, m;
    scene s;
    peri_plan_report r;
    for (correction = PERI_CORRECTION_VOLUME; correction < peri__end_correction; ++correction)
        for (m = 2; m <= 4; ++m) {
            const int slow = !test_long && correction == PERI_CORRECTION_EQUILIBRIUM; /* to make: one family in the plane */
            if (slow && m > 2) continue;
            set_scene(&s, PERI_SPACE_PLANE_STRESS, m, PERI_LAW_BOND_BASED, slow ? 28 : 60, slow ? 21 : 45, 1, 1);
            s.desc.correction = correction;
            compare(&s, "corrected", 0);
            if (slow || (!test_long && m == 3 && correction % 2)) continue; /* solids of wide families with every other correction */
            set_scene(&s, PERI_SPACE_SOLID, m, m == 3 ? PERI_LAW_LPS : PERI_LAW_BOND_BASED, test_long ? 30 : 20,
                      test_long ? 20 : 16, 8, 1);
            s.desc.correction = correction;
            if (m < 4) compare(&s, "corrected", 0);
        }
    if (test_long) set_scene(&s, PERI_SPACE_SOLID, 6.5, PERI_LAW_BOND_BASED, 20, 16, 15, 1);
    else set_scene(&s, PERI_SPACE_PLANE_STRESS, 18.5, PERI_LAW_BOND_BASED, 60, 44, 1, 1);
    s.material.critical_stretch = 1;
    CHECK(peri_plan(&s.plan, &r, NULL) == PERI_OK);
    build(&s);
    CHECK(peri_family_width(s.body) > 1024 && r.width == peri_family_width(s.body) && r.entries == peri_entry_count(s.body));
    CHECK_NEAR(r.bytes, s.memory.live, 0, 0);
    CHECK_NEAR(r.stable_step, peri_stable_step(s.body), 0.05, 0);
    peri_body_destroy(s.body);
    set_scene(&s, PERI_SPACE_PLANE_STRESS, 1000, PERI_LAW_BOND_BASED, 40, 40, 1, 1); /* all with all */
    CHECK(peri_plan(&s.plan, &r, NULL) == PERI_OK && r.entries == 1600 * 1599 && r.width == 1599 && r.stable_step > 0);
}

static void clouds_are_planned_to_5_percent(void) {
    const double amounts[3] = {0.1, 0.5, 1.0};
    int k, dim;
    for (dim = 2; dim <= 3; ++dim)
        for (k = 0; k < 5; ++k) {
            scene s;
            const int32_t space = dim == 3 ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS;
            set_scene(&s, space, k == 1 ? 2.6 : 3, PERI_LAW_BOND_BASED + k % 4, dim == 3 ? 20 : 70, dim == 3 ? 17 : 60, 15, 1);
            s.plan.source = k < 3 ? PERI_SOURCE_PERTURBED : PERI_SOURCE_POINTS;
            s.plan.amount = amounts[k % 3];
            s.desc.precision = k % 2 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
            if (k < 4) s.material.critical_stretch = 0.1;
            if (k == 4) s.desc.quadrature = PERI_QUADRATURE_RAMP;
            compare(&s, "cloud", 0);
        }
}

/* ---- memory by purpose -------------------------------------------------------------------------------------------- */

/* The entries add up to the total and that to what the allocator counts. */
static peri_memory held(const peri_body *b, const pool *p, int line) {
    peri_memory m;
    memset(&m, 0, sizeof m);
    if (peri_get_memory(b, &m) != PERI_OK || m.total != p->live
        || m.points + m.families + m.damage + m.state + m.laws + m.loads + m.fields != m.total || m.shared < 0 || m.shared > m.total) {
        test_bad++;
        printf("    line %d: total %ld, allocator %ld\n", line, (long)m.total, (long)p->live);
    }
    return m;
}
#define HELD(scene) held((scene)->body, &(scene)->memory, __LINE__)

static int32_t twist(void *user, double time, int64_t count, const int32_t *points, double *value) {
    (void)user, (void)time, (void)count, (void)points, (void)value;
    return 0;
}
static int32_t on_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    (void)user, (void)i, (void)j, (void)time, (void)stretch;
    return 0;
}

/* A life in which everything is taken that a body can take: each call adds to the purpose that it serves, and to no other. */
static void grow(scene *s, int families) {
    const int dim = s->desc.space == PERI_SPACE_SOLID ? 3 : 2;
    const double lo[3] = {0, 0, 0}, hi[3] = {2.5, 99, 99}, mid[3] = {6, 5, 3}, up[3] = {0, 1, 0}, far[3] = {6, -20, 3};
    peri_memory m, before;
    peri_material_desc other = s->material;
    peri_view view;
    int32_t field, first, second, left;
    (void)MUST(NULL, peri_body_create(&s->desc, &s->body, NULL));
    (void)HELD(s);
    first = (int32_t)MUST(s->body, peri_add_material(s->body, &s->material));
    second = (int32_t)MUST(s->body, peri_add_material(s->body, &other));
    before = HELD(s);
    (void)MUST(s->body, peri_add_box(s->body, first, s->plan.lo, s->plan.hi, 1));
    m = HELD(s);
    CHECK(m.points > before.points && m.laws == before.laws && m.shared == 0 && m.families == 0);
    if (families) { /* those that a search finds */
        const int64_t n = peri_point_count(s->body);
        peri_body *same = NULL;
        (void)MUST(NULL, peri_body_create(&s->desc, &same, NULL));
        (void)MUST(same, peri_add_material(same, &s->material));
        (void)MUST(same, peri_add_box(same, peri_id(same, PERI_KIND_MATERIAL, 1), s->plan.lo, s->plan.hi, 1));
        (void)MUST(same, peri_build(same));
        const int32_t width = peri_family_width(same);
        int32_t *rows = (int32_t *)malloc((size_t)(n * width) * sizeof *rows);
        (void)MUST(same, peri_get_families(same, 0, n, rows, n * width));
        peri_body_destroy(same);
        (void)MUST(s->body, peri_set_families(s->body, width, rows));
        free(rows);
        CHECK(HELD(s).families > 0);
    } else {
        const double edge = s->plan.hi[0], lo2[3] = {edge, 0, 0}, hi2[3] = {edge + 4, s->plan.hi[1], s->plan.hi[2]};
        (void)MUST(s->body, peri_add_perturbed_box(s->body, second, lo2, hi2, 1, 0.5, 1));
    }
    (void)HELD(s);
    if (s->material.law == PERI_LAW_BOND_BASED && !families) {
        (void)MUST(s->body, peri_set_interface(s->body, first, second, &other));
        (void)HELD(s);
    }
    (void)MUST(s->body, peri_build(s->body));
    before = HELD(s);
    CHECK(before.shared > 0 && before.state > 0 && before.families > 0 && before.fields == 0 && before.loads == 0);
    (void)MUST(s->body, peri_on_break(s->body, on_break, NULL));
    (void)MUST(s->body, peri_set_no_fail(s->body, PERI_ALL, 1));
    (void)MUST(s->body, dim == 2 ? peri_cut_segment(s->body, PERI_CUT_INITIAL, far, mid)
                                 : peri_cut_disc(s->body, PERI_CUT_INITIAL, mid, up, 2.5));
    m = HELD(s);
    CHECK(m.damage > before.damage && m.state == before.state && m.points == before.points && m.families == before.families);
    before = m;
    left = (int32_t)MUST(s->body, peri_select_box(s->body, "left", lo, hi));
    (void)MUST(s->body, peri_prescribe_displacement(s->body, left, PERI_AXIS_X, NULL, twist, NULL));
    (void)MUST(s->body, peri_apply_body_force(s->body, PERI_ALL, up, twist, NULL));
    if (s->desc.quadrature != PERI_QUADRATURE_PARTIAL_CENTROID) (void)MUST(s->body, peri_apply_pressure(s->body, left, 0.01, NULL, NULL));
    (void)MUST(s->body, plane_obstacle(s->body, far, up, 0, NULL, NULL));
    m = HELD(s);
    CHECK(m.loads > before.loads && m.damage == before.damage && m.laws == before.laws && m.state == before.state);
    before = m;
    for (field = PERI_FIELD_POSITION; field < peri__end_field; ++field) {
        (void)MUST(s->body, peri_view_field(s->body, field, &view));
        (void)HELD(s);
    }
    m = HELD(s);
    CHECK(m.fields > 0 && m.total - m.fields == before.total);
}

static void memory_is_what_the_allocator_counts(void) {
    int k, law;
    for (k = 0; k < 8; ++k)
        for (law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
            scene s;
            peri_body *copy;
            /* half of the 2^3 spaces, precisions and quadratures of each law, the same ones of every other law; all with --long */
            if (!test_long && ((k & 1) + (k >> 1 & 1) + (k >> 2) + law - PERI_LAW_BOND_BASED) % 2 == 0) continue;
            peri_memory m, c;
            const int families = k == 7 && law != PERI_LAW_CORRESPONDENCE;
            set_scene(&s, k % 2 && !families ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRAIN, families ? 1.5 : 2.2, law, 12, 9, 5, 1);
            s.desc.precision = k & 2 ? PERI_PRECISION_SINGLE : PERI_PRECISION_DOUBLE;
            s.desc.quadrature = k & 4 && !families ? PERI_QUADRATURE_PARTIAL : PERI_QUADRATURE_FULL;
            if (law == PERI_LAW_BOND_BASED && k == 4) s.desc.quadrature = PERI_QUADRATURE_PARTIAL_CENTROID;
            if (k & 1) s.desc.correction = PERI_CORRECTION_MOMENT;
            if (k == 6 && law == PERI_LAW_LPS) s.material.criterion = PERI_CRITERION_BOND_ENERGY;
            if (k == 6 && law > PERI_LAW_LPS) s.material.criterion = PERI_CRITERION_NODE_ENERGY;
            s.material.fracture_energy = 1;
            grow(&s, families);
            m = HELD(&s);
            (void)MUST(s.body, peri_body_clone(s.body, &copy, NULL));
            CHECK(peri_get_memory(copy, &c) == PERI_OK);
            CHECK(c.shared == m.shared && m.total + c.total - m.shared == s.memory.live); /* as the manual has it */
            peri_body_destroy(s.body);
            CHECK(peri_get_memory(copy, &c) == PERI_OK && c.total == s.memory.live);
            peri_body_destroy(copy);
            CHECK(s.memory.live == 0);
        }
}

/* ---- bodies that nobody builds ------------------------------------------------------------------------------------ */

/* Bonds of n cells of size 1 within m: every lattice vector, by brute force, in long double (64 bits of it are exact). */
static long double count(const int64_t *n, double m) {
    const int64_t reach = (int64_t)(m + 1e-6);
    long double sum = 0;
    int64_t v[3];
    for (v[0] = -reach; v[0] <= reach; ++v[0])
        for (v[1] = -reach; v[1] <= reach; ++v[1])
            for (v[2] = -reach; v[2] <= reach; ++v[2]) {
                long double places = 1;
                int d;
                if ((double)(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) > m * m * (1 + 1e-9)) continue;
                for (d = 0; d < 3; ++d) places *= n[d] > llabs(v[d]) ? (long double)(n[d] - llabs(v[d])) : 0;
                if (v[0] || v[1] || v[2]) sum += places;
            }
    return sum;
}

static void huge_bodies_are_counted_or_refused(void) {
    /* the second has just below, the third just above 2^31 bonds; the first and the fifth are nearly the largest that ids can number */
    static const int64_t sizes[][3] = {{1290, 1290, 1290}, {258, 258, 267},   {258, 258, 268},  {46340, 46340, 1},
                                       {2147483000, 1, 1}, {3, 715827000, 1}, {1, 7, 300000000}};
    int k, d;
    for (k = 0; k < (int)(sizeof sizes / sizeof sizes[0]); ++k) {
        const int solid = sizes[k][2] > 1;
        scene s;
        peri_plan_report r;
        set_scene(&s, solid ? PERI_SPACE_SOLID : PERI_SPACE_PLANE_STRESS, 3, PERI_LAW_BOND_BASED, 1, 1, 1, 1);
        for (d = 0; d < 3; ++d) s.plan.hi[d] = (double)sizes[k][d];
        CHECK(peri_plan(&s.plan, &r, NULL) == PERI_OK && s.memory.calls == 0);
        CHECK(r.points == sizes[k][0] * sizes[k][1] * sizes[k][2]);
        CHECK((long double)r.entries == count(sizes[k], 3));
        CHECK(r.bytes > 40 * r.points && r.bytes < 3000 * r.points && r.peak >= r.bytes);
    }
    {
        static const int64_t below[3] = {258, 258, 267}, above[3] = {258, 258, 268};
        CHECK(count(below, 3) < 2147483648.0L && count(above, 3) > 2147483648.0L);
    }
    { /* every point with every other: n(n - 1) bonds, 2^42 of them, and 2^62, whose bytes nothing can address */
        scene s;
        peri_plan_report r;
        peri_error e;
        set_scene(&s, PERI_SPACE_SOLID, 300, PERI_LAW_BOND_BASED, 128, 128, 128, 1);
        CHECK(peri_plan(&s.plan, &r, NULL) == PERI_OK && r.entries == r.points * (r.points - 1) && r.width == r.points - 1);
        set_scene(&s, PERI_SPACE_SOLID, 3000, PERI_LAW_BOND_BASED, 1290, 1290, 1290, 1);
        CHECK(peri_plan(&s.plan, &r, &e) == PERI_ERROR_TOO_LARGE && strcmp(e.field, "horizon") == 0 && e.value > 4e18 && r.points == 0);
        set_scene(&s, PERI_SPACE_SOLID, 3, PERI_LAW_BOND_BASED, 1291, 1291, 1291, 1); /* 2^31 points and more */
        CHECK(peri_plan(&s.plan, &r, &e) == PERI_ERROR_TOO_LARGE && strcmp(e.field, "spacing") == 0);
        set_scene(&s, PERI_SPACE_SOLID, 3, PERI_LAW_BOND_BASED, 1, 1, 1, 1);
        s.plan.hi[0] = 1e300;
        CHECK(peri_plan(&s.plan, &r, &e) == PERI_ERROR_TOO_LARGE);
    }
}

/* ---- the stable step and the time of a step ----------------------------------------------------------------------- */

/* Bond-based points with whole families, 28 neighbours within 3 spacings. SOURCE OF TRUTH: plane waves u = U exp(i k.xi) in a body without
   end, whose frequencies are those of the matrix sum c V/|xi| n n (1 - cos k.xi)/rho, n = xi/|xi|: the largest over a fine grid of k, those
   of a zone. The step is 2/sqrt(lambda), less 10 % at most. Twice the sum of c V/|xi|/rho bounds lambda by row sums ([T] 2.11): the step is
   no less than that gives, and no more than 2.1 times it. */
static void step_is_that_of_the_formula(void) {
    enum { WAVES = 120 };
    scene s;
    peri_plan_report r;
    const double spacing = 1e-3, young = 72e9, density = 2440, h = 3 * spacing;
    const double c = micromodulus(PERI_SPACE_PLANE_STRESS, young, h);
    double sum = 0, lambda = 0, classic, sharp;
    int x, y, p, q;
    for (x = -3; x <= 3; ++x)
        for (y = -3; y <= 3; ++y)
            if (x * x + y * y <= 9 && (x || y)) sum += c * spacing / sqrt(x * x + y * y);
    for (p = 0; p <= WAVES; ++p)
        for (q = 0; q <= WAVES; ++q) {
            const double kx = acos(-1.0) * p / WAVES, ky = acos(-1.0) * q / WAVES;
            double xx = 0, yy = 0, xy = 0;
            for (x = -3; x <= 3; ++x)
                for (y = -3; y <= 3; ++y) {
                    const double square = x * x + y * y;
                    const double a = square > 0 && square <= 9 ? c * spacing / pow(square, 1.5) * (1 - cos(kx * x + ky * y)) : 0;
                    xx += a * x * x;
                    yy += a * y * y;
                    xy += a * x * y;
                }
            lambda = fmax(lambda, (0.5 * (xx + yy) + hypot(0.5 * (xx - yy), xy)) / density);
        }
    set_scene(&s, PERI_SPACE_PLANE_STRESS, h, PERI_LAW_BOND_BASED, 1, 1, 1, 1);
    s.material.young = young;
    s.material.density = density;
    s.plan.hi[0] = s.plan.hi[1] = 0.1;
    s.plan.spacing = spacing;
    CHECK(peri_plan(&s.plan, &r, NULL) == PERI_OK && r.points == 10000);
    classic = 2 / sqrt(2 * sum / density);
    sharp = 2 / sqrt(lambda);
    CHECK(r.stable_step <= sharp && r.stable_step >= sharp / 1.1);
    CHECK(r.stable_step >= classic * (1 - 1e-12) && r.stable_step <= 2.1 * classic);
}

static void measuring_builds_and_frees_a_small_body(void) {
    scene s;
    peri_plan_report r, twice, cloud;
    peri_error e;
    int64_t k;
    set_scene(&s, PERI_SPACE_SOLID, 3, PERI_LAW_BOND_BASED, 100, 100, 100, 1);
    s.plan.measure = 1;
    CHECK(peri_plan(&s.plan, &r, &e) == PERI_OK && e.code == PERI_OK);
    CHECK(s.memory.live == 0 && s.memory.calls > 10 && s.memory.most < r.bytes / 4);
    CHECK(r.seconds > 1e-3 && r.seconds < 20); /* 1.2e8 bonds, 0.01 to 100 ns each */
    s.plan.hi[2] = 200;
    CHECK(peri_plan(&s.plan, &twice, NULL) == PERI_OK);
    CHECK_NEAR(twice.seconds / r.seconds, 2, 0.6, 0); /* on a busy machine */
    s.plan.source = PERI_SOURCE_POINTS;
    CHECK(peri_plan(&s.plan, &cloud, NULL) == PERI_OK && cloud.seconds > 0 && cloud.columns == 0);
    CHECK(cloud.stable_step <= twice.stable_step); /* the sample has close points */
    set_scene(&s, PERI_SPACE_PLANE_STRESS, 2.5, PERI_LAW_LPS, 20, 20, 1, 1);
    s.plan.measure = 1;
    for (k = 0; k < 200; ++k) { /* each of the allocations fails once */
        s.memory.calls = 0;
        s.memory.fail_at = k;
        if (peri_plan(&s.plan, &r, &e) == PERI_OK) break;
        CHECK(e.code == PERI_ERROR_MEMORY && s.memory.live == 0 && r.points == 0 && r.bytes == 0);
    }
    CHECK(k > 10 && k < 200 && r.seconds > 0);
}

/* ---- refusals ----------------------------------------------------------------------------------------------------- */

/* The code, the record, the field, and an empty report. */
static void refuses(const scene *s, int32_t code, const char *field, int line) {
    peri_plan_report r;
    peri_error e;
    memset(&r, 7, sizeof r);
    if (peri_plan(&s->plan, &r, &e) != code || e.code != code || strcmp(e.field, field) != 0 || r.points != 0 || r.stable_step != 0
        || peri_plan(&s->plan, &r, NULL) != code || s->memory.calls != 0) {
        test_bad++;
        printf("    line %d: code %d, field %s\n", line, e.code, e.field);
    }
}
#define REFUSES(change, code, field)                                                                                   \
    do {                                                                                                               \
        scene s;                                                                                                       \
        set_scene(&s, PERI_SPACE_PLANE_STRESS, 3, PERI_LAW_BOND_BASED, 20, 20, 1, 1);                                            \
        change;                                                                                                        \
        refuses(&s, code, field, __LINE__);                                                                            \
    } while (0)

static int32_t never_finite(void *user, double q, double *w) {
    (void)user, (void)q;
    *w = HUGE_VAL;
    return 0;
}
static int32_t nought(void *user, double q, double *w) {
    (void)user;
    *w = q > 2 ? 1 : 0;
    return 0;
}

static void bad_input_is_refused_by_name(void) {
    peri_plan_report r;
    peri_memory m;
    peri_plan_desc plan;
    peri_plan_desc_init(NULL);
    peri_plan_desc_init(&plan);
    CHECK(peri_plan(NULL, &r, NULL) == PERI_ERROR_ARGUMENT && peri_plan(&plan, NULL, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_get_memory(NULL, &m) == PERI_ERROR_ARGUMENT);
    REFUSES(CHECK(peri_get_memory(s.body, NULL) == PERI_ERROR_ARGUMENT); s.plan.cookie = 0, PERI_ERROR_DESCRIPTOR, "desc");
    REFUSES(s.plan.body = NULL, PERI_ERROR_ARGUMENT, "body");
    REFUSES(s.plan.material = NULL, PERI_ERROR_ARGUMENT, "material");
    REFUSES(s.desc.cookie++, PERI_ERROR_DESCRIPTOR, "desc");
    REFUSES(s.desc.precision = 9, PERI_ERROR_CHOICE, "precision");
    REFUSES(s.desc.horizon = -1, PERI_ERROR_RANGE, "horizon");
    REFUSES(s.desc.thickness = HUGE_VAL, PERI_ERROR_RANGE, "thickness");
    REFUSES(s.material.cookie = 1, PERI_ERROR_DESCRIPTOR, "material");
    REFUSES(s.material.density = 0, PERI_ERROR_RANGE, "density");
    REFUSES(s.material.poisson = 0.1, PERI_ERROR_POISSON, "poisson");
    REFUSES(s.plan.source = 0, PERI_ERROR_CHOICE, "source");
    REFUSES(s.plan.source = 4, PERI_ERROR_CHOICE, "source");
    REFUSES(s.plan.measure = 2, PERI_ERROR_CHOICE, "measure");
    REFUSES(s.plan.amount = 1.5, PERI_ERROR_RANGE, "amount");
    REFUSES(s.plan.amount = -HUGE_VAL, PERI_ERROR_RANGE, "amount");
    REFUSES(s.plan.lo[1] = HUGE_VAL, PERI_ERROR_RANGE, "lo");
    REFUSES(s.plan.hi[0] = -HUGE_VAL, PERI_ERROR_RANGE, "hi");
    REFUSES(s.plan.hi[0] = -1, PERI_ERROR_RANGE, "hi");
    REFUSES(s.plan.spacing = 0, PERI_ERROR_RANGE, "spacing");
    REFUSES(s.plan.spacing = 1e-9, PERI_ERROR_TOO_LARGE, "spacing");
    REFUSES(s.desc.horizon = 0.5, PERI_ERROR_HORIZON, "horizon");
    REFUSES(s.plan.spacing = 30, PERI_ERROR_HORIZON, "horizon");
    REFUSES(s.desc.influence = PERI_INFLUENCE_INVERSE_4, PERI_ERROR_INFLUENCE, "influence");
    REFUSES(s.desc.influence = PERI_INFLUENCE_USER; s.desc.influence_fn = never_finite, PERI_ERROR_INFLUENCE, "influence");
    REFUSES(s.desc.influence = PERI_INFLUENCE_USER; s.desc.influence_fn = nought; s.material.law = PERI_LAW_LPS; s.material.poisson = 0.2,
            PERI_ERROR_FAMILY, "influence");
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(lattices_are_planned_exactly);
    RUN(quadratures_and_influences_are_planned_exactly);
    RUN(lists_are_planned_exactly);
    RUN(corrections_and_large_families_are_planned);
    RUN(clouds_are_planned_to_5_percent);
    RUN(memory_is_what_the_allocator_counts);
    RUN(huge_bodies_are_counted_or_refused);
    RUN(step_is_that_of_the_formula);
    RUN(measuring_builds_and_frees_a_small_body);
    RUN(bad_input_is_refused_by_name);
    return test_end("test_plan");
}
