/* SPDX-License-Identifier: MIT */
/* test_misuse.c - the table of misuses (misuse.h): each call is refused by the status, the field and the value that name the mistake, and
   has changed nothing. `test_misuse --rows` prints the table, for test_misuse.py to try the same rows through a foreign function interface.
   SOURCE OF TRUTH: peri.h, which says of each status what it is for, and that `field` is the name of what is at fault. */
#include "peri_test.h"

#define ANY 1e308

/* ---- the names of the rows; test_misuse.py makes the same --------------------------------------------------------------- */

static double small[3] = {1e-3, 0, 0}, up[3] = {0, 1, 0}, up3[3] = {0, 0, 1}, lo[3] = {0, 0, 0}, hi[3] = {6, 4, 3};
static double coords[4] = {0, 0, 1, 0}, volumes[2] = {1, 1}, nans[3], out[500];
static int32_t sevens[2] = {7, 7}, pair[2] = {0, 1}, far_pair[2] = {0, 23}, wrong_points[2] = {0, -1}, ints[500];
/* built and stepped; not built; without anything; with all the materials there can be; in 3D */
static peri_body *b, *draft, *bare, *full, *solid, *made_body, **made = &made_body;
static int32_t material, set, load, support, wall, gone_load, gone_wall, draft_material;
static int32_t its_material, its_set, its_load, its_wall; /* of another body */
static peri_error record, *error = &record;
static peri_plan_report planned, *plan = &planned;
static peri_choose_report chosen, *choice = &chosen;
static peri_view seen, *view = &seen;
static peri_body_desc body_desc, *bd = &body_desc;
static peri_material_desc material_desc, *md = &material_desc;
static peri_advance_desc advance_desc, *ad = &advance_desc;
static peri_solve_desc solve_desc, *sd = &solve_desc;
static peri_plan_desc plan_desc, *pd = &plan_desc;
static peri_choose_desc choose_desc, *cd = &choose_desc;
static peri_contact_desc contact_desc, *kd = &contact_desc;
static peri_obstacle_desc obstacle_desc, *od = &obstacle_desc;
static peri_obstacle_state placed, *state = &placed;

static int32_t take_all(void *user, int64_t index, const double *x) {
    (void)user, (void)index, (void)x;
    return 1;
}
static int32_t take_none(void *user, int64_t index, const double *x) {
    (void)user, (void)index, (void)x;
    return 0;
}
static int32_t fail_point(void *user, int64_t index, const double *x) {
    (void)user, (void)x;
    return index == 5 ? -7 : 1;
}
static int32_t cut_all(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)i, (void)j, (void)xi, (void)xj;
    return 1;
}
static int32_t fail_pair(void *user, int32_t i, int32_t j, const double *xi, const double *xj) {
    (void)user, (void)j, (void)xi, (void)xj;
    return i == 5 ? -7 : 1;
}
static int32_t write_none(void *user, const void *bytes, int64_t count) {
    (void)user, (void)bytes, (void)count;
    return 1;
}

/* Settings without a mistake. */
static void good_settings(void) {
    peri_body_desc_init(bd);
    bd->space = PERI_SPACE_PLANE_STRESS;
    bd->horizon = 2.2;
    peri_material_desc_init(md, PERI_LAW_BOND_BASED);
    md->young = md->density = 1;
    peri_advance_desc_init(ad);
    ad->steps = 2;
    peri_solve_desc_init(sd);
    peri_contact_desc_init(kd);
    peri_plan_desc_init(pd);
    pd->body = bd;
    pd->material = md;
    pd->hi[0] = pd->hi[1] = 6;
    pd->spacing = 1;
    peri_choose_desc_init(cd);
    cd->preset = PERI_PRESET_TEACHING;
    cd->quantity = PERI_QUANTITY_DEFORMATION;
    cd->feature = 1;
    cd->hi[0] = cd->hi[1] = 6;
    peri_obstacle_desc_init(od, PERI_SHAPE_PLANE);
    od->place[1] = -1;
    od->normal[1] = 1;
}

static peri_body *begin(int32_t number, int32_t space, int32_t *id) {
    peri_body *body = NULL;
    good_settings();
    bd->number = number;
    bd->space = space;
    CHECK(peri_body_create(bd, &body, NULL) == PERI_OK);
    if (id) *id = (int32_t)MUST(body, peri_add_material(body, md));
    return body;
}
static peri_body *build(int32_t number, int32_t space, int32_t *id) {
    peri_body *body = begin(number, space, id);
    MUST(body, peri_add_box(body, *id, lo, hi, 1));
    MUST(body, peri_build(body));
    return body;
}
static void load_body(peri_body *body, int32_t *its) { /* a set, a load, a support, an obstacle; a load and an obstacle that are gone */
    const double left[2] = {2, 4};
    its[0] = (int32_t)MUST(body, peri_select_box(body, "left", lo, left));
    its[1] = (int32_t)MUST(body, peri_apply_body_force(body, its[0], small, NULL, NULL));
    its[2] = (int32_t)MUST(body, peri_prescribe_velocity(body, its[0], PERI_AXIS_X, NULL, NULL, NULL));
    its[3] = (int32_t)MUST(body, peri_add_obstacle(body, od));
    its[4] = (int32_t)MUST(body, peri_apply_body_force(body, PERI_ALL, small, NULL, NULL));
    its[5] = (int32_t)MUST(body, peri_add_obstacle(body, od));
    MUST(body, peri_remove_load(body, its[4]));
    MUST(body, peri_remove_obstacle(body, its[5]));
}
static peri_body *other;

static void make_all(void) {
    int32_t its[6] = {0}, id = 0;
    int k;
    memset(nans, 0xFF, sizeof nans);
    b = build(1, PERI_SPACE_PLANE_STRESS, &material);
    load_body(b, its);
    set = its[0], load = its[1], support = its[2], wall = its[3], gone_load = its[4], gone_wall = its[5];
    MUST(b, peri_advance(b, ad));
    other = build(2, PERI_SPACE_PLANE_STRESS, &its_material);
    load_body(other, its);
    its_set = its[0], its_load = its[1], its_wall = its[3];
    draft = begin(3, PERI_SPACE_PLANE_STRESS, &draft_material);
    MUST(draft, peri_add_material(draft, md));
    MUST(draft, peri_add_box(draft, draft_material, lo, hi, 1));
    bare = begin(4, PERI_SPACE_PLANE_STRESS, NULL);
    full = begin(5, PERI_SPACE_PLANE_STRESS, &id);
    for (k = 1; k < 120; ++k) MUST(full, peri_add_material(full, md));
    solid = build(6, PERI_SPACE_SOLID, &id);
}
static void destroy_all(void) {
    peri_body_destroy(b);
    peri_body_destroy(other);
    peri_body_destroy(draft);
    peri_body_destroy(bare);
    peri_body_destroy(full);
    peri_body_destroy(solid);
}

/* ---- the rows ---------------------------------------------------------------------------------------------------------- */

static uint64_t mix(uint64_t hash, const void *from, size_t count) {
    const unsigned char *at = (const unsigned char *)from;
    for (; count > 0; --count) hash = (hash ^ *at++) * UINT64_C(1099511628211);
    return hash;
}
/* Of all that a body holds and shows. */
static uint64_t digest_of(peri_body *body, uint64_t hash) {
    const int64_t counts[5] = {peri_point_count(body), peri_entry_count(body), peri_cut_count(body), peri_broken_count(body),
                               peri_step_count(body)};
    static double x[1000];
    peri_memory m;
    int32_t kind, field;
    CHECK(peri_get_memory(body, &m) == PERI_OK);
    hash = mix(mix(hash, counts, sizeof counts), &m.total, sizeof m.total);
    for (kind = PERI_KIND_MATERIAL; kind < peri__end_kind; ++kind) {
        int64_t n = 1;
        while (peri_id(body, kind, n) > 0) ++n;
        hash = mix(hash, &n, sizeof n);
    }
    if (peri_family_width(body) == 0) return hash;
    for (field = PERI_FIELD_POSITION; field < peri__end_field; ++field) {
        const int64_t n = peri_size_of_field(body, field);
        MUST(body, peri_get_field(body, field, x, 1000));
        hash = mix(hash, x, (size_t)n * sizeof *x);
    }
    return hash;
}
static uint64_t digest(void) {
    return digest_of(b, digest_of(draft, digest_of(bare, digest_of(full, digest_of(solid, 1)))));
}

static uint64_t before;
static int rows;

static void judge(const char *whose, int32_t status, const char *field, double value, int64_t result, const char *text) {
    const struct {
        const char *name;
        peri_body  *body;
    } bodies[5] = {{"b", b}, {"draft", draft}, {"bare", bare}, {"full", full}, {"solid", solid}};
    peri_error e = record;
    int k, right;
    for (k = 0; k < 5; ++k)
        if (strcmp(whose, bodies[k].name) == 0) CHECK(peri_get_error(bodies[k].body, &e) == PERI_OK);
    right = result == status;
    if (strcmp(whose, "NONE") != 0) right = right && e.code == status && strcmp(e.field, field) == 0 && (value == ANY || e.value == value);
    if (!right) printf("    %s: %d, %s, %g; expected %d, %s, %g\n", text, (int)result, e.field, e.value, status, field, value);
    CHECK(right && made_body == NULL);
    if (digest() != before) {
        printf("    %s: it has changed something\n", text);
        CHECK(0);
        before = digest();
    }
    ++rows;
}

static void each_row_is_refused(void) {
    make_all();
    (void)digest(); /* the first look at fragments takes memory */
    before = digest();
    rows = 0;
#define ROW(whose, status, field, value, call)                                                                          \
    good_settings();                                                                                                   \
    judge(#whose, PERI_ERROR_##status, field, value, (int64_t)(call), #call);
#define SET(whose, status, field, value, settings, member, setting, call)                                               \
    good_settings();                                                                                                   \
    settings->member = setting;                                                                                        \
    judge(#whose, PERI_ERROR_##status, field, value, (int64_t)(call), #settings "->" #member " = " #setting "; " #call);
#include "misuse.h"
#undef ROW
#undef SET
    printf("    %d rows\n", rows);
    CHECK(rows >= 60);
    destroy_all();
}

/* whose, status, field, value, settings, member, setting, call; the last as text */
static void print_rows(void) {
#define ROW(whose, status, field, value, call) printf("%s\t%d\t%s\t%s\t\t\t\t%s\n", #whose, PERI_ERROR_##status, field, #value, #call);
#define SET(whose, status, field, value, settings, member, setting, call)                                               \
    printf("%s\t%d\t%s\t%s\t%s\t%s\t%s\t%s\n", #whose, PERI_ERROR_##status, field, #value, #settings, #member, #setting, #call);
#include "misuse.h"
#undef ROW
#undef SET
}

/* ---- a cut where the body is ----------------------------------------------------------------------------------------------- */

static peri_body *square(void) {
    const double from[2] = {0, 0}, to[2] = {1, 1};
    peri_body *body = NULL;
    int32_t id;
    good_settings();
    bd->horizon = 0.3;
    CHECK(peri_body_create(bd, &body, NULL) == PERI_OK);
    id = (int32_t)MUST(body, peri_add_material(body, md));
    MUST(body, peri_add_box(body, id, from, to, 0.1));
    MUST(body, peri_build(body));
    return body;
}
/* Which bonds are whole. */
static void intact(peri_body *body, signed char *whole) {
    int32_t i, j;
    for (i = 0; i < 100; ++i)
        for (j = 0; j < 100; ++j) whole[100 * i + j] = (signed char)peri_bond_is_intact(body, i, j);
}
/* SOURCE OF TRUTH: a rigid motion changes no bond: what is cut relative to the body must be the same. A segment halfway up cuts 162 bonds:
   of 10 columns, the vectors (a, c), c > 0, of the horizon of 3 spacings that lead from below to above, c of them each: 10 (1 + 2 + 3) of
   a = 0, 2 x 9 (1 + 2) of a = +-1, 2 x 8 (1 + 2) of a = +-2: 60 + 54 + 48. */
static void cut_where_it_is(void) {
    static signed char want[10000], got[10000];
    const double from[2] = {-0.5, 0.5}, to[2] = {1.5, 0.5}, by[2] = {5, 0}, moved_from[2] = {4.5, 0.5}, moved_to[2] = {6.5, 0.5};
    const double turned_from[2] = {-0.5, -0.5}, turned_to[2] = {-0.5, 1.5};
    peri_body *still = square(), *moved = square(), *turned = square();
    double x[200], u[200];
    int k;
    CHECK(peri_cut_segment(still, PERI_CUT_NOW, from, to) == 162);
    intact(still, want);
    MUST(moved, peri_add_displacement(moved, PERI_ALL, by));
    CHECK(peri_cut_segment(moved, PERI_CUT_NOW, moved_from, moved_to) == 0);
    CHECK(peri_cut_segment(moved, PERI_CUT_IN_PLACE, moved_from, moved_to) == 162);
    intact(moved, got);
    CHECK(memcmp(want, got, sizeof want) == 0 && peri_broken_count(moved) == 162 && peri_cut_count(moved) == 0);
    MUST(turned, peri_get_field(turned, PERI_FIELD_POSITION, x, 200));
    for (k = 0; k < 100; ++k) { /* by 90 degrees about the origin: (x, y) to (-y, x) */
        u[2 * k] = -x[2 * k + 1] - x[2 * k];
        u[2 * k + 1] = x[2 * k] - x[2 * k + 1];
    }
    MUST(turned, peri_set_field(turned, PERI_FIELD_DISPLACEMENT, u, 200));
    CHECK(peri_cut_segment(turned, PERI_CUT_IN_PLACE, turned_from, turned_to) == 162);
    intact(turned, got);
    CHECK(memcmp(want, got, sizeof want) == 0);
    MUST(turned, peri_reset(turned));
    CHECK(peri_broken_count(turned) == 0 && peri_bond_is_intact(turned, 44, 54) == 1);
    peri_body_destroy(still);
    peri_body_destroy(moved);
    peri_body_destroy(turned);
}

int main(int argc, char **argv) {
    if (argc > 1 && strcmp(argv[1], "--rows") == 0) {
        print_rows();
        return 0;
    }
    test_begin(argc, argv);
    RUN(each_row_is_refused);
    RUN(cut_where_it_is);
    return test_end("test_misuse");
}
