/* SPDX-License-Identifier: MIT */
/* test_bond_laws.c - laws of bonds of the caller's, and interfaces between state-based materials.

   SOURCE OF TRUTH: what the library itself does by another way: its linear law and its critical stretch, its tables; the critical stretch
   that was given to a joint; central differences. */
#include "pool.h"
#include "specimen.h"

#define LIMIT 2e-3

static int32_t linear(void *user, const peri_bond_row *row) {
    (void)user;
    for (int32_t k = 0; k < row->count; ++k) row->force[k] = row->stretch[k];
    if (row->tangent)
        for (int32_t k = 0; k < row->count; ++k) row->tangent[k] = 1;
    if (row->energy)
        for (int32_t k = 0; k < row->count; ++k) row->energy[k] = 0.5 * row->stretch[k] * row->stretch[k];
    return 0;
}

/* And a criterion: beyond LIMIT, which the material does not know. */
static int32_t brittle(void *user, const peri_bond_row *row) {
    (void)linear(user, row);
    for (int32_t k = 0; row->broken && k < row->count; ++k) row->broken[k] = row->stretch[k] > LIMIT;
    return 0;
}

/* Straight down from a to b, and by secants back: what PERI_SOFTENING_BILINEAR does. state[1] counts how often it was kept. */
typedef struct ramp {
    double a, b;
} ramp;

static int32_t softening(void *user, const peri_bond_row *row) {
    const ramp *r = (const ramp *)user;
    for (int32_t k = 0; k < row->count; ++k) {
        const double s = row->stretch[k], old = fmax(row->state[2 * k], r->a), most = fmax(old, s), slope = r->a / (r->b - r->a);
        const double f = most < r->b ? slope * (r->b - most) : 0;
        const double part = s < 0 ? 1 : f / most;
        row->force[k] = s * part;
        if (row->tangent) row->tangent[k] = s > old && s < r->b ? -slope : part;
        if (row->energy) row->energy[k] = 0.5 * s * s * part;
        if (!row->lost) continue;
        row->lost[k] = 0.5 * slope * r->b * (fmin(most, r->b) - fmin(old, r->b)); /* the triangle between two secants */
        row->broken[k] = s >= r->b;
        row->state[2 * k] = most;
        row->state[2 * k + 1] += 1;
    }
    return 0;
}

typedef struct scene {
    int32_t space, geometry, precision, threads, load;
    double  critical_stretch;
    const peri_softening_desc *table;
    peri_bond_law_fn fn;
    void   *user;
    int32_t states;
} scene;

static peri_body *scene_make(const scene *c) {
    const int solid = c->space == PERI_SPACE_SOLID;
    specimen s = specimen_of(c->space, PERI_LAW_BOND_BASED, 0, 1, solid ? 2.015 : 3.015, solid ? 7 : 14, solid ? 4 : 8, 4);
    s.desc.geometry = c->geometry;
    s.desc.precision = c->precision;
    s.desc.threads = c->threads;
    s.material.critical_stretch = c->critical_stretch;
    peri_body *b = specimen_start(&s);
    const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
    if (c->table) (void)MUST(b, peri_set_softening(b, m, m, c->table));
    if (c->fn) (void)MUST(b, peri_set_bond_law(b, m, m, c->states, c->fn, c->user));
    (void)MUST(b, peri_add_box(b, m, s.lo, s.hi, 1));
    (void)MUST(b, peri_build(b));
    return b;
}

static scene scene_of(int32_t space, int32_t geometry) {
    const scene c = {space, geometry, PERI_PRECISION_DOUBLE, 1, 0, 0, NULL, NULL, NULL, 0};
    return c;
}

/* Pulled apart at both ends, by motion or in equilibrium. */
static void pull_apart(peri_body *b, int moving, double speed, int64_t steps) {
    const int dim = peri_dimension(b);
    const double length = dim == 3 ? 7 : 14, lo[3] = {0, 0, 0}, left[3] = {2, 8, 4};
    const double right[3] = {length - 2, 0, 0}, hi[3] = {length, 8, 4};
    const double way[3] = {moving ? speed : speed * length, 0, 0};
    const int32_t fixed = (int32_t)MUST(b, peri_select_box(b, NULL, lo, left));
    const int32_t pulled = (int32_t)MUST(b, peri_select_box(b, NULL, right, hi));
    const int32_t axes = dim == 3 ? PERI_AXIS_XYZ : PERI_AXIS_XY;
    (void)MUST(b, peri_prescribe_displacement(b, fixed, axes, NULL, NULL, NULL));
    if (moving) {
        peri_advance_desc a;
        peri_advance_desc_init(&a);
        (void)MUST(b, peri_prescribe_velocity(b, pulled, axes, way, NULL, NULL));
        a.steps = steps;
        a.time_step = 0.3;
        (void)MUST(b, peri_advance(b, &a));
    } else {
        peri_solve_desc st;
        peri_solve_desc_init(&st);
        (void)MUST(b, peri_prescribe_displacement(b, pulled, axes, way, NULL, NULL));
        st.steps = steps;
        (void)MUST(b, peri_solve(b, &st, NULL));
    }
}

/* The displacements of two bodies, which are then gone, to a part `rel` of the largest; the same bonds broke. */
static void same(peri_body *a, peri_body *b, double rel, int breaks) {
    const int64_t n = peri_point_count(a) * peri_dimension(a);
    double *u = (double *)malloc((size_t)(2 * n) * sizeof *u), worst = 0, size = 0;
    peri_energy e, f;
    CHECK(u != NULL);
    if (!u) return;
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, u, n));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u + n, n));
    for (int64_t k = 0; k < n; ++k) size = fmax(size, fabs(u[k])), worst = fmax(worst, fabs(u[k] - u[n + k]));
    CHECK(size > 0 && worst <= rel * size);
    CHECK(peri_broken_count(a) == peri_broken_count(b) && (peri_broken_count(a) > 0) == breaks);
    (void)MUST(a, peri_get_energy(a, &e));
    (void)MUST(b, peri_get_energy(b, &f));
    CHECK_NEAR(f.elastic, e.elastic, 10 * rel, 1e-9 * e.external);
    CHECK_NEAR(f.fracture, e.fracture, 10 * rel, 0);
    CHECK_NEAR(f.external, e.external, 10 * rel, 0);
    free(u);
    peri_body_destroy(a);
    peri_body_destroy(b);
}

static void linear_law_is_the_own_one(void) {
    static const int32_t spaces[2] = {PERI_SPACE_PLANE_STRESS, PERI_SPACE_SOLID};
    for (int k = 0; k < 4; ++k) {
        scene own = scene_of(spaces[k % 2], k < 2 ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR), theirs;
        theirs = own;
        theirs.fn = linear;
        for (int moving = 0; moving < 2; ++moving) {
            peri_body *a = scene_make(&own), *b = scene_make(&theirs);
            pull_apart(a, moving, 1e-3, moving ? 40 : 1);
            pull_apart(b, moving, 1e-3, moving ? 40 : 1);
            same(a, b, moving ? 1e-13 : 1e-7, 0); /* equilibria are found to a tolerance of 1e-8 */
        }
    }
}

/* Bonds break at the end of the step, as in PERI_BREAK_AFTER_DRIFT at its middle: which do is the same. */
static void criterion_breaks_what_it_says(void) {
    scene own = scene_of(PERI_SPACE_PLANE_STRESS, PERI_GEOMETRY_LINEAR), theirs = own;
    own.fn = linear;
    own.critical_stretch = LIMIT;
    theirs.fn = brittle;
    peri_body *a = scene_make(&own), *b = scene_make(&theirs);
    pull_apart(a, 1, 1e-3, 90);
    pull_apart(b, 1, 1e-3, 90);
    same(a, b, 0, 1);
}

/* The table of the library, and the same law by a function with a state; on one thread and on three. */
static void history_of_a_law(void) {
    peri_softening_desc table;
    ramp r;
    peri_softening_desc_init(&table, PERI_SOFTENING_BILINEAR);
    table.strength = 1e-3;
    table.fracture_energy = 40e-6;
    for (int k = 0; k < 4; ++k) {
        scene own = scene_of(PERI_SPACE_PLANE_STRESS, k % 2 ? PERI_GEOMETRY_NONLINEAR : PERI_GEOMETRY_LINEAR), theirs = own;
        const int moving = k / 2;
        own.table = &table;
        theirs.fn = softening;
        theirs.user = &r;
        theirs.states = 2;
        theirs.threads = 3;
        peri_body *a = scene_make(&own);
        const int32_t m = peri_id(a, PERI_KIND_MATERIAL, 1);
        (void)MUST(a, peri_get_softening(a, m, m, &r.a, &r.b));
        peri_body *b = scene_make(&theirs);
        pull_apart(a, moving, moving ? 2e-3 : 2e-2, moving ? 700 : 12);
        pull_apart(b, moving, moving ? 2e-3 : 2e-2, moving ? 700 : 12);
        same(a, b, moving ? 1e-9 : 1e-5, 1);
    }
}

static int32_t stiffening(void *user, const peri_bond_row *row) {
    (void)user;
    for (int32_t k = 0; k < row->count; ++k) {
        const double s = row->stretch[k];
        row->force[k] = s + 20 * s * s * s;
        if (row->tangent) row->tangent[k] = 1 + 60 * s * s;
        if (row->energy) row->energy[k] = 0.5 * s * s + 5 * s * s * s * s;
    }
    return 0;
}

static void tangent_of_a_law(void) {
    scene c = scene_of(PERI_SPACE_SOLID, PERI_GEOMETRY_NONLINEAR);
    double u[336], v[336], f[2][336], k[336], worst = 0, size = 0;
    uint64_t seed = 11;
    peri_evaluate_desc e;
    c.fn = stiffening;
    peri_body *b = scene_make(&c);
    const int n = (int)peri_point_count(b) * 3;
    CHECK(n == 336);
    for (int q = 0; q < n; ++q) u[q] = 0.2 * test_random(&seed);
    for (int q = 0; q < n; ++q) v[q] = test_random(&seed) - 0.5;
    (void)MUST(b, peri_multiply_stiffness_at(b, u, v, k, n));
    for (int side = 0; side < 2; ++side) {
        double moved[336];
        for (int q = 0; q < n; ++q) moved[q] = u[q] + (side ? -1e-6 : 1e-6) * v[q];
        peri_evaluate_desc_init(&e);
        e.displacement = moved;
        e.force = f[side];
        e.nodal = 1;
        (void)MUST(b, peri_evaluate(b, &e, NULL));
    }
    for (int q = 0; q < n; ++q) size = fmax(size, fabs(k[q])), worst = fmax(worst, fabs(k[q] + (f[0][q] - f[1][q]) / 2e-6));
    CHECK(worst < 1e-6 * size);
    (void)MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, n));
    peri_matrix *matrix = NULL;
    (void)MUST(b, peri_matrix_create(b, &matrix));
    const int64_t rows = peri_matrix_rows(matrix), entries = peri_matrix_entries(matrix);
    int64_t *start = (int64_t *)malloc((size_t)(rows + 1) * sizeof *start);
    int32_t *column = (int32_t *)malloc((size_t)entries * sizeof *column);
    double *value = (double *)malloc((size_t)entries * sizeof *value);
    CHECK(start && column && value);
    if (start && column && value) {
        (void)MUST(b, peri_get_matrix(matrix, start, column, value));
        worst = 0;
        for (int64_t q = 0; q < rows; ++q) {
            double sum = 0;
            for (int64_t at = start[q]; at < start[q + 1]; ++at) sum += value[at] * v[column[at]];
            worst = fmax(worst, fabs(sum - k[q]));
        }
        CHECK(worst < 1e-12 * size);
    }
    free(start), free(column), free(value);
    peri_matrix_destroy(matrix);
    peri_body_destroy(b);
}

/* ---- failing, refused ---------------------------------------------------------------------------------------------------- */

static int fails;
static int32_t failing(void *user, const peri_bond_row *row) {
    (void)linear(user, row);
    if (row->point == 5 && fails == 1) return -1;
    if (row->point == 5 && fails == 3) return fails = 0, -1; /* once */
    if (row->point == 5 && fails == 2) row->force[0] = (double)NAN;
    return 0;
}

static void failures_end_the_call(void) {
    for (int how = 1; how < 4; ++how) {
        scene c = scene_of(PERI_SPACE_PLANE_STRESS, PERI_GEOMETRY_LINEAR);
        peri_advance_desc a;
        peri_solve_desc st;
        peri_error e;
        double f[224];
        peri_evaluate_desc ev;
        c.fn = failing;
        fails = 0;
        peri_body *b = scene_make(&c);
        pull_apart(b, 1, 1e-3, 1);
        fails = how;
        peri_advance_desc_init(&a);
        a.steps = 3;
        CHECK(peri_advance(b, &a) == PERI_ERROR_CALLBACK);
        CHECK(peri_get_error(b, &e) == PERI_OK && e.index == 5 && strcmp(e.field, "peri_bond_law_fn") == 0);
        CHECK(peri_step_count(b) < 3);
        if (how == 3) MUST(b, peri_reset(b));
        fails = how;
        peri_solve_desc_init(&st);
        CHECK(peri_solve(b, &st, NULL) == PERI_ERROR_CALLBACK);
        fails = how;
        peri_evaluate_desc_init(&ev);
        ev.force = f;
        CHECK(peri_evaluate(b, &ev, NULL) == PERI_ERROR_CALLBACK);
        fails = 0;
        (void)MUST(b, peri_reset(b));
        (void)MUST(b, peri_advance(b, &a));
        peri_body_destroy(b);
    }
}

static void what_has_no_such_law_is_refused(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 3.015, 6, 6, 1);
    peri_body *b = specimen_start(&s);
    peri_error e;
    peri_solve_desc st;
    const int32_t lps = peri_id(b, PERI_KIND_MATERIAL, 1);
    peri_material_desc springs = s.material;
    springs.law = PERI_LAW_BOND_BASED;
    springs.poisson = (double)NAN;
    const int32_t spring = (int32_t)MUST(b, peri_add_material(b, &springs));
    CHECK(peri_set_bond_law(b, lps, lps, 0, linear, NULL) == PERI_ERROR_LAW);
    CHECK(peri_set_bond_law(b, lps, spring, 0, linear, NULL) == PERI_ERROR_LAW);
    CHECK(peri_set_bond_law(b, spring, spring, 9, linear, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_set_bond_law(b, spring, spring, 0, NULL, NULL) == PERI_ERROR_ARGUMENT);
    CHECK(peri_set_bond_law(b, spring, spring, 0, linear, NULL) == PERI_OK);
    const double middle[2] = {3, 6}, rest[2] = {3, 0};
    (void)MUST(b, peri_add_box(b, lps, s.lo, middle, 1));
    (void)MUST(b, peri_add_box(b, spring, rest, s.hi, 1));
    CHECK(peri_build(b) == PERI_ERROR_LAW && peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "peri_set_bond_law") == 0);
    peri_body_destroy(b);
    s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.015, 6, 6, 1); /* criteria beyond the stretch */
    s.material.criterion = PERI_CRITERION_VON_MISES;
    s.material.strength = 1;
    b = specimen_start(&s);
    const int32_t strong = peri_id(b, PERI_KIND_MATERIAL, 1);
    (void)MUST(b, peri_set_bond_law(b, strong, strong, 0, linear, NULL));
    (void)MUST(b, peri_add_box(b, strong, s.lo, s.hi, 1));
    CHECK(peri_build(b) == PERI_ERROR_CRITERION && peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "criterion") == 0);
    peri_body_destroy(b);
    scene c = scene_of(PERI_SPACE_PLANE_STRESS, PERI_GEOMETRY_LINEAR);
    c.fn = linear;
    b = scene_make(&c);
    peri_solve_desc_init(&st);
    st.control = PERI_CONTROL_FRACTURE;
    CHECK(peri_solve(b, &st, NULL) == PERI_ERROR_LAW);
    peri_body_destroy(b);
}

/* Whatever allocation fails nothing leaks, and what the body says it holds is what it took. */
static void short_of_memory(void) {
    for (int64_t fail = 0;; ++fail) {
        pool p = {0, 0, 0, 0, -1, 0};
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.015, 6, 5, 1);
        peri_softening_desc table;
        peri_body *b, *copy = NULL;
        peri_memory held;
        hook(&s.desc, &p);
        peri_softening_desc_init(&table, PERI_SOFTENING_EXPONENTIAL);
        table.strength = 1e-3;
        table.fracture_energy = 1e-4;
        b = specimen_start(&s);
        const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
        p.calls = 0;
        p.fail_at = fail;
        int32_t status = peri_set_softening(b, m, m, &table);
        if (status == PERI_OK) status = (int32_t)peri_add_box(b, m, s.lo, s.hi, 1);
        if (status >= 0) status = peri_build(b);
        if (status == PERI_OK) status = peri_body_clone(b, &copy, NULL);
        CHECK(status == PERI_OK || status == PERI_ERROR_MEMORY);
        const int done = p.calls <= fail;
        if (done) (void)MUST(b, peri_get_memory(b, &held));
        peri_body_destroy(copy);
        CHECK(!done || (p.bytes == held.total && held.damage > 8 * peri_entry_count(b)));
        peri_body_destroy(b);
        CHECK(p.blocks == 0 && p.bytes == 0 && p.wrong == 0);
        if (done || fail > 200) break;
    }
}

/* ---- interfaces ------------------------------------------------------------------------------------------------------------ */

typedef struct joint {
    int32_t of[400];
    int     across, within;
    double  least;
} joint;

static int32_t note_break(void *user, int32_t i, int32_t j, double time, double stretch) {
    joint *w = (joint *)user;
    (void)time;
    w->least = fmin(w->least, stretch);
    if (w->of[i] == w->of[j]) w->within++;
    else w->across++;
    return 0;
}

/* Blocks of one state-based law, or of two, glued by what bears a quarter of their stretch. */
static void weak_joint(int32_t first, int32_t second) {
    const double mid[2] = {10, 5}, mid0[2] = {10, 0}, left[2] = {3, 5}, right[2] = {17, 0}, pull[2] = {0.014 * 14, 0}, zero[2] = {0, 0};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, first, 0.25, 1, 3.015, 20, 5, 1);
    double material[400];
    joint seen = {{0}, 0, 0, 1};
    peri_solve_desc st;
    s.material.critical_stretch = 0.04;
    peri_body *b = specimen_start(&s);
    peri_material_desc other = s.material, glue;
    peri_material_desc_init(&other, second);
    other.young = 1;
    other.poisson = second == PERI_LAW_BOND_BASED ? (double)NAN : 0.25;
    other.density = 1;
    other.critical_stretch = 0.04;
    const int32_t one = peri_id(b, PERI_KIND_MATERIAL, 1), two = (int32_t)MUST(b, peri_add_material(b, &other));
    double s0;
    glue = s.material;
    glue.critical_stretch = 0.01;
    glue.young = 1e6; /* the stiffness stays that of the blocks */
    (void)MUST(b, peri_set_interface(b, one, two, &glue));
    (void)MUST(b, peri_get_bond_constants(b, two, one, NULL, &s0));
    CHECK(s0 == 0.01);
    (void)MUST(b, peri_add_box(b, one, s.lo, mid, 1));
    (void)MUST(b, peri_add_box(b, two, mid0, s.hi, 1));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_MATERIAL, material, 400));
    for (int k = 0; k < 100; ++k) seen.of[k] = (int32_t)material[k];
    (void)MUST(b, peri_on_break(b, note_break, &seen));
    (void)MUST(b, peri_prescribe_displacement(b, peri_select_box(b, NULL, zero, left), PERI_AXIS_XY, NULL, NULL, NULL));
    (void)MUST(b, peri_prescribe_displacement(b, peri_select_box(b, NULL, right, s.hi), PERI_AXIS_XY, pull, NULL, NULL));
    peri_solve_desc_init(&st);
    st.steps = 10;
    (void)MUST(b, peri_solve(b, &st, NULL));
    CHECK(seen.across > 20 && seen.within == 0 && seen.least > 0.01 && seen.least < 0.012);
    peri_body_destroy(b);
}

static void joints_of_state_based_blocks(void) {
    weak_joint(PERI_LAW_LPS, PERI_LAW_LPS);
    weak_joint(PERI_LAW_CORRESPONDENCE, PERI_LAW_LPS);
    weak_joint(PERI_LAW_LPS, PERI_LAW_BOND_BASED);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(linear_law_is_the_own_one);
    RUN(criterion_breaks_what_it_says);
    RUN(history_of_a_law);
    RUN(tangent_of_a_law);
    RUN(failures_end_the_call);
    RUN(what_has_no_such_law_is_refused);
    RUN(short_of_memory);
    RUN(joints_of_state_based_blocks);
    return test_end("test_bond_laws");
}
