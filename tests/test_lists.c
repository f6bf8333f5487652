/* test_lists.c - whatever an enum of peri.h names is served, and the number after the last is refused by the name of its field.

   SOURCE OF TRUTH: peri.h: every number below a PERI_..._COUNT_ is a choice, the count itself is none. A field does not depend on what was
   in the caller's buffer. The moments of an influence function are those of the forces that it makes: [P] C.18, c I_2 = 3E/(pi h^3). */
#include "scene.h"

#define UNWRITTEN 6.02214076e123

/* ---- statuses ----------------------------------------------------------------------------------------------------- */

static void statuses_have_texts(void) {
    const int32_t last = PERI_STOPPED - PERI_STATUS_COUNT_ + 1;
    const char *unknown = peri_status_text(-1000);
    CHECK(strcmp(unknown, "unknown status") == 0);
    CHECK(peri_status_text(PERI_STOPPED + 1) == unknown && peri_status_text(last - 1) == unknown);
    for (int32_t a = PERI_STOPPED; a >= last; --a) {
        CHECK(peri_status_text(a)[0] != '\0' && strcmp(peri_status_text(a), unknown) != 0);
        for (int32_t c = PERI_STOPPED; c > a; --c) CHECK(strcmp(peri_status_text(a), peri_status_text(c)) != 0);
    }
}

/* ---- fields ------------------------------------------------------------------------------------------------------- */

/* A body under way: cut, broken, loaded and held. */
static peri_body *busy(int32_t space) {
    const double tip[2] = {0.4, 0.3}, mouth[2] = {0.4, -0.1}, up[3] = {1, 0, 0};
    const double centre[3] = {0.4, 0, 0.2};
    const double lo[3] = {-1, -1, -1}, hi[3] = {0.1, 2, 2}, pull[3] = {0.2, 0.1, 0};
    peri_body *b = block(space, PERI_F64, PERI_NONLINEAR, 8, 6, 4);
    const int32_t left = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    if (space == PERI_SOLID) MUST(b, peri_cut_disc(b, centre, up, 0.25));
    else MUST(b, peri_cut_segment(b, tip, mouth));
    MUST(b, peri_prescribe_displacement(b, left, 1, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL));
    (void)go(b, PERI_VELOCITY_VERLET, 5, 0, 0);
    return b;
}

/* Reads a field into a buffer full of `before`, with one number more than it may touch. */
static double *read_over(peri_body *b, int32_t field, int64_t n, double before) {
    double *out = (double *)calloc((size_t)n + 1, sizeof *out);
    for (int64_t k = 0; k <= n; ++k) out[k] = before;
    MUST(b, peri_read(b, field, out, n));
    CHECK(out[n] == before);
    return out;
}

static void field_is_served(peri_body *b, int32_t field) {
    const int64_t points = peri_point_count(b), n = MUST(b, peri_field_size(b, field));
    peri_view v;
    double *one = read_over(b, field, n, UNWRITTEN), *other = read_over(b, field, n, -3);
    int bad = test_bad;
    MUST(b, peri_view_field(b, field, &v));
    CHECK(v.count == points && v.count * v.components == n);
    for (int64_t k = 0; k < n; ++k) {
        const int32_t d = (int32_t)(k % v.components);
        const int64_t at = k / v.components * v.point_stride + d * v.component_stride;
        CHECK(one[k] != UNWRITTEN && one[k] == other[k]);
        CHECK(one[k] == v.offset[d] + v.scale * ((const double *)v.data)[at]);
    }
    CHECK(peri_read(b, field, one, n - 1) == PERI_ERROR_CAPACITY);
    if (test_bad > bad) printf("    field %d of %d\n", (int)field, PERI_FIELD_COUNT_ - 1);
    free(one);
    free(other);
}

static void every_field_is_served(void) {
    for (int32_t space = PERI_PLANE_STRESS; space < PERI_SPACE_COUNT_; ++space) {
        peri_body *b = busy(space);
        peri_view v;
        peri_error e;
        double x[4] = {0, 0, 0, 0};
        for (int32_t field = 1; field < PERI_FIELD_COUNT_; ++field) field_is_served(b, field);
        for (int32_t field = 0; field <= PERI_FIELD_COUNT_; field += PERI_FIELD_COUNT_) {
            CHECK(peri_field_size(b, field) == PERI_ERROR_FIELD && peri_write(b, field, x, 4) == PERI_ERROR_FIELD);
            CHECK(peri_read(b, field, x, 4) == PERI_ERROR_FIELD && peri_view_field(b, field, &v) == PERI_ERROR_FIELD);
            CHECK(peri_last_error(b, &e) == PERI_OK && strcmp(e.field, "field") == 0 && e.index == field);
        }
        peri_body_destroy(b);
    }
}

/* ---- influence functions ------------------------------------------------------------------------------------------ */

static double falling(void *user, double q) {
    (void)user;
    return 1.0 - 0.5 * q * q * q;
}

/* Two points q apart, horizon 1, edge of the cells 1/2. NULL where the library does not take the function. */
static peri_body *two_points(int32_t influence, double q) {
    double x[4] = {0, 0, 0, 0}, volume[2] = {0.25, 0.25};
    peri_body_desc d;
    peri_body *b = NULL;
    peri_error e;
    x[2] = q;
    peri_body_desc_init(&d);
    d.space = PERI_PLANE_STRESS;
    d.geometry = PERI_LINEAR;
    d.influence = influence;
    d.influence_fn = falling;
    d.horizon = 1;
    d.threads = 1;
    CHECK(peri_body_create(&d, &b, NULL) == PERI_OK);
    (void)unbreakable(b, YOUNG, DENSITY);
    MUST(b, peri_add_points(b, 2, x, volume, NULL));
    if (peri_build(b) == PERI_OK) return b;
    CHECK(peri_last_error(b, &e) == PERI_OK && e.code == PERI_ERROR_INFLUENCE && strcmp(e.field, "influence") == 0);
    peri_body_destroy(b);
    return NULL;
}

/* c w(q) from the force density c w s V on the first point. 0: no such body. */
static double pull_of(int32_t influence, double q) {
    const double stretch = 1e-3, apart[4] = {0, 0, stretch * q, 0};
    peri_body *b = two_points(influence, q);
    double *f, pull;
    if (!b) return 0;
    put(b, PERI_DISPLACEMENT, apart);
    f = get(b, PERI_FORCE_DENSITY);
    pull = f[0] / (stretch * 0.25);
    free(f);
    peri_body_destroy(b);
    return pull;
}

/* The integral of c w(q) q^2 over [0, 1] by Fejer's first rule. */
#define NODES 32
static double moment_of_pulls(int32_t influence) {
    double sum = 0;
    for (int k = 0; k < NODES; ++k) {
        const double angle = (k + 0.5) * PI / NODES, q = 0.5 * (1 - cos(angle));
        double weight = 1;
        for (int j = 1; j <= NODES / 2; ++j) weight -= 2 * cos(2 * j * angle) / (4.0 * j * j - 1);
        sum += weight / NODES * pull_of(influence, q) * q * q;
    }
    return sum;
}

static void moments_are_those_of_the_forces(void) {
    for (int32_t w = 1; w < PERI_INFLUENCE_COUNT_; ++w) {
        const int none = w == PERI_INFLUENCE_INVERSE_4 || w == PERI_INFLUENCE_POLE_HALF || w == PERI_INFLUENCE_POLE_QUARTER;
        int bad = test_bad;
        if (none) CHECK(pull_of(w, 0.7) == 0);
        else CHECK_NEAR(moment_of_pulls(w), 3 * YOUNG / PI, 1e-11, 0);
        if (test_bad > bad) printf("    influence function %d of %d\n", (int)w, PERI_INFLUENCE_COUNT_ - 1);
    }
}

/* ---- choices of descriptors --------------------------------------------------------------------------------------- */

static int32_t create(const peri_body_desc *d, peri_error *e) {
    peri_body *b = NULL;
    const int32_t status = peri_body_create(d, &b, e);
    peri_body_destroy(b);
    return status;
}

/* peri_body_create takes every choice from `first` on in a member of the descriptor (but `hole`), and not the one after the last. */
#define CREATES(member, first, count, hole)                                                                            \
    do {                                                                                                               \
        peri_body_desc d;                                                                                              \
        peri_error e;                                                                                                  \
        peri_body_desc_init(&d);                                                                                       \
        d.space = PERI_PLANE_STRAIN;                                                                                   \
        d.horizon = 1;                                                                                                 \
        d.influence_fn = falling;                                                                                      \
        for (d.member = (first); d.member < (count); ++d.member)                                                       \
            if (d.member != (hole)) CHECK(create(&d, &e) == PERI_OK);                                                  \
        CHECK(create(&d, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, #member) == 0);                                 \
        d.member = (first)-1;                                                                                          \
        CHECK(create(&d, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, #member) == 0);                                 \
    } while (0)

static void bodies_take_every_choice(void) {
    CREATES(space, 1, PERI_SPACE_COUNT_, 0);
    CREATES(precision, 1, PERI_TYPE_COUNT_, PERI_I32);
    CREATES(geometry, 1, PERI_GEOMETRY_COUNT_, 0);
    CREATES(influence, 1, PERI_INFLUENCE_COUNT_, 0);
    CREATES(quadrature, 1, PERI_QUADRATURE_COUNT_, 0);
    CREATES(break_timing, 1, PERI_BREAK_TIMING_COUNT_, 0);
    CREATES(correction, 1, PERI_CORRECTION_COUNT_, 0);
    CREATES(kernel, 0, PERI_KERNEL_COUNT_, -1);
    CREATES(instructions, 0, PERI_INSTRUCTIONS_COUNT_, -1);
}

/* The choice after the last, in a descriptor that is good otherwise. */
#define BEYOND(desc, member, count, call)                                                                              \
    do {                                                                                                               \
        const int32_t good = (desc).member;                                                                            \
        (desc).member = (count);                                                                                       \
        CHECK((call) == PERI_ERROR_ARGUMENT && peri_last_error(b, &e) == PERI_OK && strcmp(e.field, #member) == 0);    \
        (desc).member = good;                                                                                          \
    } while (0)

static void choices_after_the_last_are_refused(void) {
    peri_body *b = block(PERI_PLANE_STRESS, PERI_F64, PERI_LINEAR, 4, 4, 1), *fresh = empty(PERI_PLANE_STRESS, PERI_F64, PERI_LINEAR, 1);
    peri_error e;
    peri_run run;
    peri_statics st;
    peri_material m;
    peri_run_init(&run);
    run.steps = 1;
    BEYOND(run, integrator, PERI_INTEGRATOR_COUNT_, peri_advance(b, &run));
    peri_statics_init(&st);
    BEYOND(st, method, PERI_METHOD_COUNT_, peri_solve(b, &st, NULL));
    BEYOND(st, preconditioner, PERI_PRECONDITIONER_COUNT_, peri_solve(b, &st, NULL));
    BEYOND(st, loose, PERI_LOOSE_COUNT_, peri_solve(b, &st, NULL));
    peri_body_destroy(b);
    b = fresh;
    peri_material_init(&m, PERI_BOND_BASED);
    m.young = m.density = 1;
    BEYOND(m, model, PERI_MODEL_COUNT_, peri_add_material(b, &m));
    BEYOND(m, criterion, PERI_CRITERION_COUNT_, peri_add_material(b, &m));
    CHECK(peri_add_material(b, &m) == 0);
    peri_body_destroy(b);
}

/* The same of calls that have no body. */
static void questions_after_the_last_are_refused(void) {
    peri_body_desc d;
    peri_material m;
    peri_plan_desc plan;
    peri_plan_report report;
    peri_goal goal;
    peri_choice choice;
    peri_error e;
    peri_body_desc_init(&d);
    d.space = PERI_PLANE_STRESS;
    d.horizon = 3;
    peri_material_init(&m, PERI_BOND_BASED);
    m.young = m.density = 1;
    peri_plan_desc_init(&plan);
    plan.body = &d;
    plan.material = &m;
    plan.spacing = 1;
    plan.hi[0] = plan.hi[1] = 10;
    for (plan.source = 1; plan.source < PERI_SOURCE_COUNT_; ++plan.source) CHECK(peri_plan(&plan, &report, &e) == PERI_OK);
    CHECK(peri_plan(&plan, &report, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, "source") == 0);
    peri_goal_init(&goal);
    goal.feature = 1;
    goal.hi[0] = goal.hi[1] = 10;
    goal.preset = PERI_PRESET_GAME;
    for (goal.quantity = 1; goal.quantity < PERI_QUANTITY_COUNT_; ++goal.quantity)
        CHECK(peri_choose(&goal, &d, &m, &choice, &e) == PERI_OK && choice.text[0] != '\0');
    CHECK(peri_choose(&goal, &d, &m, &choice, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, "quantity") == 0);
    goal.quantity = PERI_FOR_DEFORMATION;
    goal.preset = PERI_PRESET_COUNT_;
    CHECK(peri_choose(&goal, &d, &m, &choice, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, "preset") == 0);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(statuses_have_texts);
    RUN(every_field_is_served);
    RUN(moments_are_those_of_the_forces);
    RUN(bodies_take_every_choice);
    RUN(choices_after_the_last_are_refused);
    RUN(questions_after_the_last_are_refused);
    return test_end("test_lists");
}
