/* SPDX-License-Identifier: MIT */
/* test_lists.c - whatever an enum of peri.h names is served, and any other number is refused by the name of its field.

   SOURCE OF TRUTH: peri.h, whose text is read here: its enums name what there is, and have disjoint values, so that one in the wrong field
   is refused. A field does not depend on what was in the caller's buffer. The moments of an influence function are those of the forces
   that it makes: [P] C.18, c I_2 = 3E/(pi h^3). */
#include "scene.h"

#define UNWRITTEN 6.02214076e123

/* ---- groups ------------------------------------------------------------------------------------------------------- */

typedef struct group {
    const char *name; /* of the enum, without peri_ */
    int32_t     first, end, count;
} group;

#define GROUP(name) {#name, peri__first_##name, peri__end_##name, peri__count_##name}
#define GROUPS      31
static const group groups[GROUPS] = {
    GROUP(status),      GROUP(space),      GROUP(precision), GROUP(geometry),     GROUP(influence), GROUP(quadrature), GROUP(break_timing),
    GROUP(correction),  GROUP(kernel),     GROUP(law),       GROUP(instructions), GROUP(criterion), GROUP(integrator), GROUP(method),
    GROUP(preconditioner), GROUP(loose),   GROUP(type),      GROUP(source),       GROUP(quantity),  GROUP(preset),     GROUP(field),
    GROUP(standing),    GROUP(kind),       GROUP(moments),   GROUP(shape),
    GROUP(control),     GROUP(ended),     GROUP(softening), GROUP(unloading), GROUP(reduction), GROUP(bond)};

static int group_of(const char *name) {
    for (int k = 0; k < GROUPS; ++k)
        if (strcmp(groups[k].name, name) == 0) return k;
    return -1;
}

/* Each enum of the header, but that of axes, is a group, and has the values of the group in order, one to a line, and no others. */
static void groups_are_the_enums(void) {
    FILE *file = fopen("peri.h", "r"); /* tests run at the root of the repository */
    char line[256], name[64];
    int seen[GROUPS] = {0}, value, k = -1;
    CHECK(file != NULL);
    if (!file) return;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "typedef enum peri_%63[a-z_]", name) == 1) {
            k = group_of(name);
            if (k < 0 && strcmp(name, "axis") != 0) {
                test_bad++;
                printf("    %s: no group\n", name);
            }
        } else if (line[0] == '}') {
            k = -1;
        } else if (k >= 0 && sscanf(line, " PERI_%63[A-Z0-9_] = %d", name, &value) == 2) {
            if (value != (k == 0 ? groups[k].end - 1 - seen[k] : groups[k].first + seen[k])) {
                test_bad++;
                printf("    PERI_%s is %d\n", name, value);
            }
            seen[k]++;
        }
    }
    (void)fclose(file);
    for (k = 0; k < GROUPS; ++k) {
        if (seen[k] == groups[k].count && seen[k] == groups[k].end - groups[k].first) continue;
        test_bad++;
        printf("    %s has %d values, its group %d\n", groups[k].name, seen[k], (int)groups[k].count);
    }
}

/* Statuses lie below 100, and each other group has a hundred of its own, of which it leaves the first number, and those of the axes. */
static void groups_are_disjoint(void) {
    CHECK(groups[0].end <= 100);
    for (int k = 1; k < GROUPS; ++k) {
        CHECK(groups[k].first >= 100 && groups[k].first % 100 == 1 && groups[k].count < 100);
        CHECK(groups[k].end <= PERI_AXIS_X || groups[k].first > PERI_AXIS_XYZ);
        for (int other = 1; other < k; ++other) CHECK(groups[k].first / 100 != groups[other].first / 100);
    }
}

/* ---- statuses ----------------------------------------------------------------------------------------------------- */

static void statuses_have_texts(void) {
    const int32_t last = peri__first_status;
    const char *unknown = peri_status_text(-1000);
    CHECK(strcmp(unknown, "unknown status") == 0);
    CHECK(peri_status_text(PERI_BRITTLE + 1) == unknown && peri_status_text(last - 1) == unknown);
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
    MUST(b, peri_prescribe_displacement(b, left, PERI_AXIS_X, NULL, NULL, NULL));
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
    if (test_bad > bad) printf("    field %d\n", (int)field);
    free(one);
    free(other);
}

static void every_field_is_served(void) {
    static const int32_t none[4] = {0, 1, peri__first_field - 1, peri__end_field};
    for (int32_t space = PERI_SPACE_PLANE_STRESS; space < peri__end_space; ++space) {
        peri_body *b = busy(space);
        peri_view v;
        peri_error e;
        double x[4] = {0, 0, 0, 0};
        for (int32_t field = peri__first_field; field < peri__end_field; ++field) field_is_served(b, field);
        for (int k = 0; k < 4; ++k) {
            const int32_t field = none[k];
            CHECK(peri_size_of_field(b, field) == PERI_ERROR_CHOICE && peri_set_field(b, field, x, 4) == PERI_ERROR_CHOICE);
            CHECK(peri_get_field(b, field, x, 4) == PERI_ERROR_CHOICE && peri_view_field(b, field, &v) == PERI_ERROR_CHOICE);
            CHECK(peri_get_error(b, &e) == PERI_OK && strcmp(e.field, "field") == 0 && e.value == field);
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
    for (int32_t w = peri__first_influence; w < peri__end_influence; ++w) {
        const int none = w == PERI_INFLUENCE_INVERSE_4 || w == PERI_INFLUENCE_POLE_HALF || w == PERI_INFLUENCE_POLE_QUARTER;
        int bad = test_bad;
        if (none) CHECK(pull_of(w, 0.7) == 0);
        else CHECK_NEAR(moment_of_pulls(w), 3 * YOUNG / PI, 1e-11, 0);
        if (test_bad > bad) printf("    influence function %d\n", (int)w);
    }
}

/* ---- choices of descriptors --------------------------------------------------------------------------------------- */

static int32_t create(const peri_body_desc *d, peri_error *e) {
    peri_body *b = NULL;
    const int32_t status = peri_body_create(d, &b, e);
    peri_body_destroy(b);
    return status;
}

/* peri_body_create takes every choice in a member of the descriptor, and none that belongs in another. */
#define CREATES(member)                                                                                                \
    do {                                                                                                               \
        peri_body_desc d;                                                                                              \
        peri_error e;                                                                                                  \
        peri_body_desc_init(&d);                                                                                       \
        d.space = PERI_SPACE_PLANE_STRAIN;                                                                             \
        d.horizon = 1;                                                                                                 \
        d.influence_fn = falling;                                                                                      \
        for (d.member = peri__first_##member; d.member < peri__end_##member; ++d.member)                               \
            CHECK(create(&d, &e) == PERI_OK);                                                                          \
        REFUSED(d.member, peri__end_##member, #member, create(&d, &e));                                                \
        REFUSED(d.member, peri__first_##member - 1, #member, create(&d, &e));                                          \
        for (int k = 0; k < GROUPS; ++k)                                                                               \
            if (groups[k].first != peri__first_##member) REFUSED(d.member, groups[k].first, #member, create(&d, &e));  \
    } while (0)

/* The call with `what` in a member of its descriptor says in e that this is none of its choices. */
#define REFUSED(member, what, name, call)                                                                              \
    do {                                                                                                               \
        (member) = (what);                                                                                             \
        CHECK((call) == PERI_ERROR_CHOICE && e.code == PERI_ERROR_CHOICE && strcmp(e.field, name) == 0 && e.value == (member)); \
    } while (0)

static void bodies_take_every_choice(void) {
    CREATES(space);
    CREATES(precision);
    CREATES(geometry);
    CREATES(influence);
    CREATES(quadrature);
    CREATES(break_timing);
    CREATES(correction);
    CREATES(moments);
    CREATES(kernel);
    CREATES(instructions);
}

/* What is no choice, in a descriptor that is good otherwise. */
#define BEYOND(desc, member, call)                                                                                     \
    do {                                                                                                               \
        const int32_t good = (desc).member;                                                                            \
        REFUSED((desc).member, peri__end_##member, #member, said(b, (call), &e));                                      \
        REFUSED((desc).member, peri__first_##member - 1, #member, said(b, (call), &e));                                \
        REFUSED((desc).member, 1, #member, said(b, (call), &e));                                                       \
        (desc).member = good;                                                                                          \
    } while (0)

static int32_t said(const peri_body *b, int32_t result, peri_error *e) {
    CHECK(peri_get_error(b, e) == PERI_OK);
    return result;
}

static void other_choices_are_refused(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    peri_body *fresh = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1);
    const double from[2] = {0, 0}, to[2] = {1, 1};
    int32_t choice;
    peri_error e;
    peri_advance_desc run;
    peri_solve_desc st;
    peri_material_desc m;
    peri_advance_desc_init(&run);
    run.steps = 1;
    BEYOND(run, integrator, peri_advance(b, &run));
    peri_solve_desc_init(&st);
    BEYOND(st, method, peri_solve(b, &st, NULL));
    BEYOND(st, preconditioner, peri_solve(b, &st, NULL));
    BEYOND(st, loose, peri_solve(b, &st, NULL));
    peri_obstacle_desc obstacle;
    peri_obstacle_desc_init(&obstacle, PERI_SHAPE_BALL);
    BEYOND(obstacle, shape, peri_add_obstacle(b, &obstacle));
    for (int k = 0; k < 3; ++k) {
        const int32_t standings[3] = {1, peri__first_standing - 1, peri__end_standing};
        const int32_t kinds[3] = {1, peri__first_kind - 1, peri__end_kind};
        const int32_t several[3] = {1, PERI_AXIS_X - 1, PERI_AXIS_XYZ}; /* no axis of a plane, none at all, and one too many */
        REFUSED(choice, standings[k], "standing", said(b, (int32_t)peri_cut_segment(b, choice, from, to), &e));
        REFUSED(choice, kinds[k], "kind", said(b, peri_id(b, choice, 1), &e));
        REFUSED(choice, several[k], "axes", said(b, peri_prescribe_velocity(b, PERI_ALL, choice, NULL, NULL, NULL), &e));
    }
    peri_body_destroy(b);
    b = fresh;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = 1;
    BEYOND(m, law, peri_add_material(b, &m));
    BEYOND(m, criterion, peri_add_material(b, &m));
    CHECK(PERI_ID_INDEX(peri_add_material(b, &m)) == 1);
    peri_body_destroy(b);
}

/* The same of calls that have no body. */
static void other_questions_are_refused(void) {
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
    for (plan.source = peri__first_source; plan.source < peri__end_source; ++plan.source) CHECK(peri_plan(&plan, &report, &e) == PERI_OK);
    REFUSED(plan.source, peri__end_source, "source", peri_plan(&plan, &report, &e));
    REFUSED(plan.source, 1, "source", peri_plan(&plan, &report, &e));
    peri_choose_desc_init(&goal);
    goal.feature = 1;
    goal.hi[0] = goal.hi[1] = 10;
    goal.preset = PERI_PRESET_GAME;
    for (goal.quantity = peri__first_quantity; goal.quantity < peri__end_quantity; ++goal.quantity)
        CHECK(peri_choose(&goal, &d, &m, &choice, &e) == PERI_OK && choice.text[0] != '\0');
    REFUSED(goal.quantity, peri__end_quantity, "quantity", peri_choose(&goal, &d, &m, &choice, &e));
    REFUSED(goal.quantity, 1, "quantity", peri_choose(&goal, &d, &m, &choice, &e));
    goal.quantity = PERI_QUANTITY_DEFORMATION;
    REFUSED(goal.preset, peri__end_preset, "preset", peri_choose(&goal, &d, &m, &choice, &e));
    REFUSED(goal.preset, 1, "preset", peri_choose(&goal, &d, &m, &choice, &e));
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(groups_are_the_enums);
    RUN(groups_are_disjoint);
    RUN(statuses_have_texts);
    RUN(every_field_is_served);
    RUN(moments_are_those_of_the_forces);
    RUN(bodies_take_every_choice);
    RUN(other_choices_are_refused);
    RUN(other_questions_are_refused);
    return test_end("test_lists");
}
