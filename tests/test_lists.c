/* test_lists.c - whatever an enum of peri.h names is served, and the number after the last is refused by the name of its field.

   SOURCE OF TRUTH: peri.h: every number below a PERI_..._COUNT_ is a choice, the count itself is none. A field does not depend on what was
   in the caller's buffer. The moments of an influence function are those of the forces that it makes: [P] C.18, c I_2 = 3E/(pi h^3). */
#include "scene.h"

#define UNWRITTEN 6.02214076e123

/* ---- statuses ----------------------------------------------------------------------------------------------------- */

static void statuses_have_texts(void) {
    const int32_t last = PERI_STOPPED - peri__end_status + 1;
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
    peri_body *b = block(space, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_NONLINEAR, 8, 6, 4);
    const int32_t left = (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi));
    if (space == PERI_SPACE_SOLID) MUST(b, peri_cut_disc(b, PERI_CUT_INITIAL, centre, up, 0.25));
    else MUST(b, peri_cut_segment(b, PERI_CUT_INITIAL, tip, mouth));
    MUST(b, peri_prescribe_displacement(b, left, 1, NULL, NULL, NULL));
    MUST(b, peri_apply_body_force(b, PERI_ALL, pull, NULL, NULL));
    (void)go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 5, 0, 0);
    return b;
}

/* Reads a field into a buffer full of `before`, with one number more than it may touch. */
static double *read_over(peri_body *b, int32_t field, int64_t n, double before) {
    double *out = (double *)calloc((size_t)n + 1, sizeof *out);
    for (int64_t k = 0; k <= n; ++k) out[k] = before;
    MUST(b, peri_get_field(b, field, out, n));
    CHECK(out[n] == before);
    return out;
}

static void field_is_served(peri_body *b, int32_t field) {
    const int64_t points = peri_point_count(b), n = MUST(b, peri_size_of_field(b, field));
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
    CHECK(peri_get_field(b, field, one, n - 1) == PERI_ERROR_CAPACITY);
    if (test_bad > bad) printf("    field %d of %d\n", (int)field, peri__end_field - 1);
    free(one);
    free(other);
}

static void every_field_is_served(void) {
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
        peri_body *b = busy(space);
        peri_view v;
        peri_error e;
        double x[4] = {0, 0, 0, 0};
        for (int32_t field = 1; field < peri__end_field; ++field) field_is_served(b, field);
        for (int32_t field = 0; field <= peri__end_field; field += peri__end_field) {
            CHECK(peri_size_of_field(b, field) == PERI_ERROR_FIELD && peri_set_field(b, field, x, 4) == PERI_ERROR_FIELD);
            CHECK(peri_get_field(b, field, x, 4) == PERI_ERROR_FIELD && peri_view_field(b, field, &v) == PERI_ERROR_FIELD);
            CHECK(peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "field") == 0 && e.index == field);
        }
        peri_body_destroy(b);
    }
}

/* ---- influence functions ------------------------------------------------------------------------------------------ */

static int32_t falling(void *user, double q, double *w) {
    (void)user;
    *w = 1.0 - 0.5 * q * q * q;
    return 0;
}

/* Two points q apart, horizon 1, edge of the cells 1/2. NULL where the library does not take the function. */
static peri_body *two_points(int32_t influence, double q) {
    double x[4] = {0, 0, 0, 0}, volume[2] = {0.25, 0.25};
    peri_body_desc d;
    peri_body *b = NULL;
    peri_error e;
    x[2] = q;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.geometry = PERI_GEOMETRY_LINEAR;
    d.influence = influence;
    d.influence_fn = falling;
    d.horizon = 1;
    d.threads = 1;
    CHECK(peri_body_create(&d, &b, NULL) == PERI_OK);
    (void)unbreakable(b, YOUNG, DENSITY);
    MUST(b, peri_add_points(b, 2, x, volume, NULL));
    if (peri_build(b) == PERI_OK) return b;
    CHECK(peri_get_error(b, &e) == PERI_OK && e.code == PERI_ERROR_INFLUENCE && strcmp(e.field, "influence") == 0);
    peri_body_destroy(b);
    return NULL;
}

/* c w(q) from the force density c w s V on the first point. 0: no such body. */
static double pull_of(int32_t influence, double q) {
    const double stretch = 1e-3, apart[4] = {0, 0, stretch * q, 0};
    peri_body *b = two_points(influence, q);
    double *f, pull;
    if (!b) return 0;
    put(b, PERI_FIELD_DISPLACEMENT, apart);
    f = get(b, PERI_FIELD_FORCE_DENSITY);
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
    for (int32_t w = 1; w < peri__end_influence; ++w) {
        const int none = w == PERI_INFLUENCE_INVERSE_4 || w == PERI_INFLUENCE_POLE_HALF || w == PERI_INFLUENCE_POLE_QUARTER;
        int bad = test_bad;
        if (none) CHECK(pull_of(w, 0.7) == 0);
        else CHECK_NEAR(moment_of_pulls(w), 3 * YOUNG / PI, 1e-11, 0);
        if (test_bad > bad) printf("    influence function %d of %d\n", (int)w, peri__end_influence - 1);
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
        d.space = PERI_SPACE_PLANE_STRAIN;                                                                                   \
        d.horizon = 1;                                                                                                 \
        d.influence_fn = falling;                                                                                      \
        for (d.member = (first); d.member < (count); ++d.member)                                                       \
            if (d.member != (hole)) CHECK(create(&d, &e) == PERI_OK);                                                  \
        CHECK(create(&d, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, #member) == 0);                                 \
        d.member = (first)-1;                                                                                          \
        CHECK(create(&d, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, #member) == 0);                                 \
    } while (0)

static void bodies_take_every_choice(void) {
    CREATES(space, 1, peri__end_space, 0);
    CREATES(precision, 1, peri__end_type, PERI_TYPE_I32);
    CREATES(geometry, 1, peri__end_geometry, 0);
    CREATES(influence, 1, peri__end_influence, 0);
    CREATES(quadrature, 1, peri__end_quadrature, 0);
    CREATES(break_timing, 1, peri__end_break_timing, 0);
    CREATES(correction, 1, peri__end_correction, 0);
    CREATES(kernel, 0, peri__end_kernel, -1);
    CREATES(instructions, 0, peri__end_instructions, -1);
}

/* The choice after the last, in a descriptor that is good otherwise. */
#define BEYOND(desc, member, count, call)                                                                              \
    do {                                                                                                               \
        const int32_t good = (desc).member;                                                                            \
        (desc).member = (count);                                                                                       \
        CHECK((call) == PERI_ERROR_ARGUMENT && peri_get_error(b, &e) == PERI_OK && strcmp(e.field, #member) == 0);    \
        (desc).member = good;                                                                                          \
    } while (0)

static void choices_after_the_last_are_refused(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1), *fresh = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1);
    peri_error e;
    peri_advance_desc run;
    peri_solve_desc st;
    peri_material_desc m;
    peri_advance_desc_init(&run);
    run.steps = 1;
    BEYOND(run, integrator, peri__end_integrator, peri_advance(b, &run));
    peri_solve_desc_init(&st);
    BEYOND(st, method, peri__end_method, peri_solve(b, &st, NULL));
    BEYOND(st, preconditioner, peri__end_preconditioner, peri_solve(b, &st, NULL));
    BEYOND(st, loose, peri__end_loose, peri_solve(b, &st, NULL));
    peri_body_destroy(b);
    b = fresh;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    BEYOND(m, law, peri__end_law, peri_add_material(b, &m));
    BEYOND(m, criterion, peri__end_criterion, peri_add_material(b, &m));
    CHECK(peri_add_material(b, &m) == 0);
    peri_body_destroy(b);
}

/* The same of calls that have no body. */
static void questions_after_the_last_are_refused(void) {
    peri_body_desc d;
    peri_material_desc m;
    peri_plan_desc plan;
    peri_plan_report report;
    peri_choose_desc goal;
    peri_choose_report choice;
    peri_error e;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    peri_plan_desc_init(&plan);
    plan.body = &d;
    plan.material = &m;
    plan.spacing = 1;
    plan.hi[0] = plan.hi[1] = 10;
    for (plan.source = 1; plan.source < peri__end_source; ++plan.source) CHECK(peri_plan(&plan, &report, &e) == PERI_OK);
    CHECK(peri_plan(&plan, &report, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, "source") == 0);
    peri_choose_desc_init(&goal);
    goal.feature = 1;
    goal.hi[0] = goal.hi[1] = 10;
    goal.preset = PERI_PRESET_GAME;
    for (goal.quantity = 1; goal.quantity < peri__end_quantity; ++goal.quantity)
        CHECK(peri_choose(&goal, &d, &m, &choice, &e) == PERI_OK && choice.text[0] != '\0');
    CHECK(peri_choose(&goal, &d, &m, &choice, &e) == PERI_ERROR_ARGUMENT && strcmp(e.field, "quantity") == 0);
    goal.quantity = PERI_QUANTITY_DEFORMATION;
    goal.preset = peri__end_preset;
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
