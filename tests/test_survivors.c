/* SPDX-License-Identifier: MIT */
/* test_survivors.c - what `make mutants` found that no other test looked at: texts and records of errors, and constants.

   SOURCE OF TRUTH: peri.h and docs/manual.md, which say of each status what field, index and value name, and of each function what it does;
   decimal numbers as they are written here. */
#include "refusal.h"

/* ---- texts of errors ----------------------------------------------------------------------------------------------- */

/* What peri_format_error makes of a value. */
static const char *said(double value) {
    static char text[128];
    peri_error e = {PERI_ERROR_RANGE, 0, -1, value, "x", ""};
    char whole[160];
    CHECK(peri_format_error(&e, whole, sizeof whole) < (int64_t)sizeof whole);
    CHECK(strncmp(whole, ": x value ", 10) == 0);
    strcpy(text, whole + 10);
    return text;
}

/* Decimal text of at most 16 digits that reads back as the number. */
static void check_number(double value) {
    const char *text = said(value);
    const double back = strtod(text, NULL);
    CHECK(strlen(text) <= 26);
    if (!(fabs(back - value) <= 1e-15 * fabs(value))) {
        printf("    %.17g is written %s\n", value, text);
        test_bad++;
    }
}

static void numbers_are_written(void) {
    int k;
    CHECK(strcmp(said((double)NAN), "nan") == 0);
    CHECK(strcmp(said(HUGE_VAL), "inf") == 0 && strcmp(said(-HUGE_VAL), "-inf") == 0);
    CHECK(strcmp(said(0), "0") == 0 && strcmp(said(-2.5), "-2.5") == 0 && strcmp(said(100), "1e2") == 0);
    CHECK(strcmp(said(0.0625), "6.25e-2") == 0 && strcmp(said(10), "1e1") == 0);
    for (k = -300; k <= 300; ++k) { /* powers of ten and what is next to them, where digits and exponent carry over */
        char power[16];
        (void)snprintf(power, sizeof power, "1e%d", k);
        const double ten = strtod(power, NULL);
        check_number(ten);
        check_number(nextafter(ten, 0));
        check_number(-nextafter(ten, HUGE_VAL));
        check_number(ten / 3);
    }
    for (k = 100; k < 200; ++k) { /* three digits are written as three digits: their rounding is less than half of the sixteenth */
        CHECK(strtod(said(k / 100.0), NULL) == k / 100.0);
        CHECK(strlen(said(k / 100.0)) <= 4);
    }
    for (k = 1000; k < 1126; ++k) CHECK(strtod(said(k / 1000.0), NULL) == k / 1000.0 && strlen(said(k / 1000.0)) <= 5);
    check_number(1.7e308);
    check_number(2.2250738585072014e-308);
}

static const char *text_of(const peri_body *b) {
    static char text[256];
    peri_error e;
    CHECK(peri_get_error(b, &e) == PERI_OK && strcmp(e.text, peri_status_text(e.code)) == 0);
    CHECK(peri_format_error(&e, text, sizeof text) > 0);
    return text;
}

/* manual.md: index and value where there are any; of wrong ids what they are; of PERI_ERROR_ORDER whether peri_build was called. */
static void errors_are_told(void) {
    const double nowhere[4] = {(double)NAN, 0, 1, 1}, origin[3] = {0, 0, 0}, there[4] = {0, 0, 1, 1}, volumes[2] = {1, 1};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1);
    const int32_t glass = unbreakable(b, 1, 1), pair[2] = {glass, 7};
    char small[8];
    memset(small, 'x', sizeof small);
    REFUSE(b, PERI_ERROR_POINT, peri_add_points(b, 2, nowhere, volumes, NULL));
    CHECK(strstr(text_of(b), ": positions index 0, value nan") != NULL);
    REFUSE(b, PERI_ERROR_ID_NONE, peri_add_points(b, 2, there, volumes, pair));
    CHECK(strstr(text_of(b), ": materials index 1 is 7") != NULL);
    REFUSE(b, PERI_ERROR_ORDER, peri_select_ball(b, NULL, origin, 1));
    CHECK(strstr(text_of(b), ": peri_build was not called") != NULL);
    REFUSE(b, PERI_ERROR_CHOICE, peri_id(b, 0, 1));
    CHECK(strstr(text_of(b), ": kind value 0") != NULL);
    CHECK(peri_format_error(&seen, small, 7) == (int64_t)strlen(text_of(b)) && small[6] == 0 && small[7] == 'x');
    CHECK(strncmp(small, text_of(b), 6) == 0);
    peri_body_destroy(b);

    b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    const int32_t material = peri_id(b, PERI_KIND_MATERIAL, 1);
    char want[64];
    REFUSE(b, PERI_ERROR_ID_KIND, peri_size_of_set(b, material));
    (void)snprintf(want, sizeof want, "set is material 1 of body %d", (material >> 20) & 0x7F);
    CHECK(strstr(text_of(b), want) != NULL);
    REFUSE(b, PERI_ERROR_ID_KIND, peri_size_of_set(b, (1 << 27) + 5)); /* of no body: no id that was ever given */
    CHECK(strstr(text_of(b), "134217733") != NULL);
    peri_body_destroy(b);

    b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1);
    peri_body *c = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    const int32_t ours = unbreakable(b, 1, 1), set = (int32_t)MUST(c, peri_select_ball(c, NULL, origin, 1)), mixed[2] = {ours, set};
    REFUSE(b, PERI_ERROR_ID_KIND, peri_add_points(b, 2, there, volumes, mixed));
    CHECK(seen.index == 1 && seen.value == set);
    (void)snprintf(want, sizeof want, "materials index 1 is set 1 of body %d", (set >> 20) & 0x7F);
    CHECK(strstr(text_of(b), want) != NULL);
    peri_body_destroy(c);
    peri_body_destroy(b);
}

/* ---- what is at fault ---------------------------------------------------------------------------------------------- */

#define AT_FAULT(name, at, number) CHECK(seen.field && strcmp(seen.field, name) == 0 && seen.index == (at) && seen.value == (number))

static void vectors_are_looked_at_whole(void) {
    const double first[3] = {(double)NAN, 0, 0}, second[3] = {0, HUGE_VAL, 0}, one[3] = {1, 1, 1};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    REFUSE(b, PERI_ERROR_RANGE, peri_select_box(b, NULL, first, one));
    CHECK(strcmp(seen.field, "lo") == 0 && seen.value != seen.value);
    REFUSE(b, PERI_ERROR_RANGE, peri_select_box(b, NULL, one, second));
    AT_FAULT("hi", -1, HUGE_VAL);
    peri_body_destroy(b);
}

static void materials_name_what_is_wrong(void) {
    peri_material_desc m;
    peri_body *b = empty(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1);
    const int32_t first = unbreakable(b, 1, 1);
    int k;
    peri_material_desc_init(&m, PERI_LAW_LPS);
    m.young = m.density = 1;
    m.poisson = 0.5; /* in (-1, 1/2) */
    REFUSE(b, PERI_ERROR_RANGE, peri_add_material(b, &m));
    AT_FAULT("poisson", -1, 0.5);
    m.poisson = -1;
    REFUSE(b, PERI_ERROR_RANGE, peri_add_material(b, &m));
    AT_FAULT("poisson", -1, -1);
    m.poisson = 0.3;
    m.criterion = PERI_CRITERION_BOND_ENERGY; /* lacks its G0 */
    REFUSE(b, PERI_ERROR_CRITERION, peri_add_material(b, &m));
    AT_FAULT("fracture_energy", -1, PERI_CRITERION_BOND_ENERGY);
    m.criterion = PERI_CRITERION_STRETCH;
    const int32_t lps = (int32_t)MUST(b, peri_add_material(b, &m));
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = m.density = m.fracture_energy = 1;
    m.criterion = PERI_CRITERION_BOND_ENERGY; /* cannot act on this law */
    REFUSE(b, PERI_ERROR_CRITERION, peri_add_material(b, &m));
    AT_FAULT("criterion", -1, PERI_CRITERION_BOND_ENERGY);
    m.criterion = PERI_CRITERION_STRETCH;
    m.poisson = 0.3; /* the ratio of the law is the value */
    REFUSE(b, PERI_ERROR_POISSON, peri_add_material(b, &m));
    AT_FAULT("poisson", -1, 0.25);
    m.poisson = (double)NAN;
    REFUSE(b, PERI_ERROR_LAW, peri_set_interface(b, first, lps, &m));
    for (k = 3; k <= 120; ++k) MUST(b, peri_add_material(b, &m));
    REFUSE(b, PERI_ERROR_TOO_LARGE, peri_add_material(b, &m));
    CHECK(seen.value == 120);
    peri_body_destroy(b);
}

/* manual.md: the density of an interface is not used; a second call for the same pair replaces the first. */
static void interfaces_are_replaced(void) {
    peri_material_desc m;
    peri_body *b = empty(PERI_SPACE_PLANE_STRAIN, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1);
    const int32_t p = unbreakable(b, 1, 1), q = unbreakable(b, 3, 1);
    double c, soft;
    peri_material_desc_init(&m, PERI_LAW_BOND_BASED);
    m.young = 1;
    MUST(b, peri_set_interface(b, p, q, &m));
    MUST(b, peri_get_bond_constants(b, p, q, &soft, NULL));
    m.young = 2;
    MUST(b, peri_set_interface(b, p, q, &m)); /* in the same order */
    MUST(b, peri_get_bond_constants(b, p, q, &c, NULL));
    CHECK_NEAR(c, 2 * soft, 1e-14, 0);
    m.young = 4;
    MUST(b, peri_set_interface(b, q, p, &m)); /* and the other way about */
    MUST(b, peri_get_bond_constants(b, p, q, &c, NULL));
    CHECK_NEAR(c, 4 * soft, 1e-14, 0);
    peri_body_destroy(b);
}

/* Constants beyond the numbers of double are refused: c goes as E/h^4, w0 as G0/h^4. */
static void constants_have_a_range(void) {
    static const double horizons[2] = {1e-90, 1e90};
    int k;
    for (k = 0; k < 2; ++k) {
        peri_material_desc m;
        peri_body *b = empty(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, horizons[k]);
        const int32_t bonds = unbreakable(b, 1, 1);
        double number = 7;
        REFUSE(b, PERI_ERROR_RANGE, peri_get_bond_constants(b, bonds, bonds, &number, NULL));
        CHECK(strcmp(seen.field, "c") == 0 && number == 7);
        peri_material_desc_init(&m, PERI_LAW_LPS);
        m.young = m.density = m.fracture_energy = 1;
        m.poisson = 0.3;
        m.criterion = PERI_CRITERION_BOND_ENERGY;
        const int32_t states = (int32_t)MUST(b, peri_add_material(b, &m));
        REFUSE(b, PERI_ERROR_RANGE, peri_get_critical_energy(b, states, &number));
        CHECK(strcmp(seen.field, "w0") == 0 && number == 7);
        peri_body_destroy(b);
    }
}

/* A normal has a direction, whatever its length. */
static void tiny_normals_have_a_direction(void) {
    static const double length[3] = {1, 1e-200, 1e200};
    double force[3][2] = {{0, 0}, {0, 0}, {0, 0}};
    int k;
    for (k = 0; k < 3; ++k) {
        const double place[3] = {0.2, 0.2, 0}, normal[3] = {3 * length[k], 4 * length[k], 0};
        peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
        const int32_t wall = (int32_t)MUST(b, plane_obstacle(b, place, normal, 1, NULL, NULL));
        MUST(b, peri_get_obstacle_force(b, wall, force[k], NULL));
        CHECK_NEAR(force[k][1] / force[k][0], 4.0 / 3, 1e-12, 0);
        CHECK_NEAR(force[k][0], force[0][0], 1e-12, 0);
        peri_body_destroy(b);
    }
    CHECK(force[0][0] > 0);
}

static void *give(void *user, uint64_t bytes) {
    (void)user;
    return malloc((size_t)bytes);
}

static void take(void *user, void *pointer, uint64_t bytes) {
    (void)user;
    (void)bytes;
    free(pointer);
}

static void bodies_name_what_is_wrong(void) {
    static const double bad[2] = {HUGE_VAL, 0};
    peri_body_desc d;
    peri_body *b = NULL;
    int k;
#define NO_BODY(setting, status, name, number)                                                                         \
    do {                                                                                                               \
        peri_body_desc_init(&d);                                                                                       \
        d.space = PERI_SPACE_SOLID;                                                                                    \
        d.horizon = 1;                                                                                                 \
        setting;                                                                                                       \
        CHECK(peri_body_create(&d, &b, &seen) == (status) && b == NULL);                                               \
        AT_FAULT(name, -1, number);                                                                                    \
    } while (0)
    NO_BODY(d.quadrature = PERI_QUADRATURE_PARTIAL_MOMENT, PERI_ERROR_CHOICE, "quadrature", PERI_QUADRATURE_PARTIAL_MOMENT); /* 2D */
    NO_BODY(d.quadrature = PERI_QUADRATURE_PARTIAL_CENTROID, PERI_ERROR_CHOICE, "quadrature", PERI_QUADRATURE_PARTIAL_CENTROID);
    NO_BODY((d.space = PERI_SPACE_PLANE_STRESS, d.quadrature = PERI_QUADRATURE_PARTIAL_MOMENT, d.correction = PERI_CORRECTION_ENERGY),
            PERI_ERROR_CHOICE, "correction", PERI_CORRECTION_ENERGY);
    NO_BODY(d.allocate = give, PERI_ERROR_ARGUMENT, "release", 0); /* both or neither: what is missing is at fault */
    NO_BODY(d.release = take, PERI_ERROR_ARGUMENT, "allocate", 0);
    for (k = 0; k < 2; ++k) {
        NO_BODY(d.thickness = bad[k], PERI_ERROR_RANGE, "thickness", bad[k]);
        NO_BODY(d.horizon = bad[k], PERI_ERROR_RANGE, "horizon", bad[k]);
    }
#undef NO_BODY
}

static void sets_and_cracks_name_what_is_wrong(void) {
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, sliver[3] = {0.5, 1e-14, 0};
    peri_body *b = block(PERI_SPACE_SOLID, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 4);
    const int32_t all = (int32_t)MUST(b, peri_select_ball(b, "all", o, 9));
    MUST(b, peri_select_ball(b, "others", o, 9));
    REFUSE(b, PERI_ERROR_NAME, peri_select_ball(b, "all", o, 1)); /* taken: by the set whose id is the index */
    AT_FAULT("name", all, 0);
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_triangle(b, PERI_CUT_NOW, o, x, x));
    AT_FAULT("r", -1, 0);
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_triangle(b, PERI_CUT_NOW, o, x, sliver)); /* no extent beside its length */
    AT_FAULT("r", -1, 0);
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_rectangle(b, PERI_CUT_NOW, o, x, x));
    AT_FAULT("edge2", -1, 0);
    CHECK(peri_broken_count(b) == 0 && peri_cut_triangle(b, PERI_CUT_NOW, o, x, y) >= 0);
    peri_body_destroy(b);
    b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    REFUSE(b, PERI_ERROR_CRACK, peri_cut_segment(b, PERI_CUT_NOW, o, o));
    AT_FAULT("to", -1, 0);
    peri_body_destroy(b);
}

/* peri.h: up to 1e15 spacings and 1e9 speeds of sound; what is added is added to what there is. */
static void motion_has_a_range(void) {
    const double spacing = 0.1, sound = sqrt(YOUNG / DENSITY);
    double far[2] = {0.9e15 * spacing, 0}, fast[2] = {0, 0.9e9 * sound}, some[2] = {1, 2}, more[2] = {0.5, -4};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    int k;
    MUST(b, peri_add_displacement(b, PERI_ALL, far));
    MUST(b, peri_add_velocity(b, PERI_ALL, fast));
    MUST(b, peri_reset(b));
    far[0] = 1.1e15 * spacing;
    REFUSE(b, PERI_ERROR_RANGE, peri_add_displacement(b, PERI_ALL, far));
    CHECK(strcmp(seen.field, "value") == 0 && seen.index == 0);
    CHECK_NEAR(seen.value, far[0], 1e-14, 0);
    fast[1] = 1.1e9 * sound;
    REFUSE(b, PERI_ERROR_RANGE, peri_add_velocity(b, PERI_ALL, fast));
    CHECK(strcmp(seen.field, "value") == 0 && seen.index == 0);
    CHECK_NEAR(seen.value, fast[1], 1e-14, 0);
    MUST(b, peri_add_displacement(b, PERI_ALL, some));
    MUST(b, peri_add_displacement(b, PERI_ALL, more));
    double *u = get(b, PERI_FIELD_DISPLACEMENT);
    for (k = 0; k < 16; ++k) CHECK(fabs(u[2 * k] - 1.5) < 1e-14 && fabs(u[2 * k + 1] + 2) < 1e-14);
    u[7] = 0.9e15 * spacing; /* of point 3, written */
    MUST(b, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 32));
    u[7] = 1.1e15 * spacing;
    REFUSE(b, PERI_ERROR_RANGE, peri_set_field(b, PERI_FIELD_DISPLACEMENT, u, 32));
    AT_FAULT("in", 3, u[7]);
    free(u);
    peri_body_destroy(b);
}

/* manual.md: 1e11 spacings of nonlinear correspondence in mixed and single precision, which cubes displacements. */
static void cubes_have_a_range(void) {
    int k;
    for (k = 0; k < 4; ++k) {
        const double far[2] = {1e12, 0};
        specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_CORRESPONDENCE, 0.3, 1, 2, 4, 4, 1);
        s.desc.precision = k == 0 ? PERI_PRECISION_SINGLE : k == 1 ? PERI_PRECISION_DOUBLE : PERI_PRECISION_MIXED;
        s.desc.geometry = k == 2 ? PERI_GEOMETRY_LINEAR : PERI_GEOMETRY_NONLINEAR;
        peri_body *b = specimen_make(&s);
        if (k == 1 || k == 2) MUST(b, peri_add_displacement(b, PERI_ALL, far));
        else REFUSE(b, PERI_ERROR_RANGE, peri_add_displacement(b, PERI_ALL, far));
        peri_body_destroy(b);
    }
}

/* Forces that the state cannot hold; the index is a point, not its place in a set. */
static void forces_have_a_range(void) {
    const int32_t some[2] = {7, 9};
    const double huge[2] = {0, 1e38};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_SINGLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    double f[32];
    const int32_t set = (int32_t)MUST(b, peri_select_points(b, NULL, 2, some));
    MUST(b, peri_apply_body_force(b, set, huge, NULL, NULL)); /* times the spacing, over the modulus: as the body has it */
    CHECK(peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 32) == PERI_OK);
    const double beyond[2] = {0, 1e42};
    MUST(b, peri_apply_body_force(b, set, beyond, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, peri_get_field(b, PERI_FIELD_FORCE_DENSITY, f, 32));
    CHECK(strcmp(seen.field, "value") == 0 && seen.index == 7);
    peri_body_destroy(b);
}

/* manual.md: places beyond 1e15 spacings are refused. */
static void obstacles_have_a_range(void) {
    const double away[2] = {2e15 * H, 0}, near[2] = {-9, 0}, up[2] = {1, 0}, beyond[2] = {1e308, 0};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    MUST(b, plane_obstacle(b, near, up, 1, NULL, NULL));
    REFUSE(b, PERI_ERROR_RANGE, ball_obstacle(b, away, 1, 1, NULL, NULL));
    AT_FAULT("place", -1, away[0]);
    REFUSE(b, PERI_ERROR_RANGE, ball_obstacle(b, near, 2e15 * H, 1, NULL, NULL));
    CHECK(strcmp(seen.field, "radius") == 0);
    CHECK_NEAR(seen.value, 2e15 * H, 1e-15, 0);
    REFUSE(b, PERI_ERROR_RANGE, plane_obstacle(b, beyond, up, 1, NULL, NULL)); /* over the spacing it is no number */
    AT_FAULT("place", -1, beyond[0]);
    peri_body_destroy(b);
}

/* manual.md: materials that no point has may have any numbers; those in use are refused by their index where they differ too much. */
static void contrasts_have_a_range(void) {
    const double x[6] = {0, 0, 1, 0, 2, 0}, v[3] = {1, 1, 1}, odd[3] = {1e300, 1e300, 1e-300};
    int turn;
    for (turn = 0; turn < 2; ++turn) {
        peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_MIXED, PERI_GEOMETRY_LINEAR, 1.5);
        const int32_t hard = unbreakable(b, 1, 1), soft = unbreakable(b, 1e-30, 1), wild = unbreakable(b, 1e240, 1e-240);
        const int32_t of[3] = {hard, turn ? soft : hard, hard};
        (void)wild;
        MUST(b, peri_add_points(b, 3, x, v, of));
        if (!turn) MUST(b, peri_build(b));
        else {
            REFUSE(b, PERI_ERROR_RANGE, peri_build(b));
            CHECK(strcmp(seen.field, "young") == 0 && seen.index == 1);
        }
        peri_body_destroy(b);
    }
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 3, x, odd, NULL)); /* in the units of the first the last has none left */
    REFUSE(b, PERI_ERROR_POINT, peri_build(b));
    CHECK(strcmp(seen.field, "volumes") == 0 && seen.index == 2);
    peri_body_destroy(b);
}

/* peri.h: "ids hold in both". */
static void clones_have_the_ids(void) {
    const double o[3] = {0, 0, 0};
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1), *copy = NULL;
    const int32_t set = (int32_t)MUST(b, peri_select_ball(b, "set", o, 9));
    MUST(b, peri_body_clone(b, &copy, NULL));
    CHECK(peri_find_set(copy, "set") == set && peri_size_of_set(copy, set) == 16);
    CHECK(peri_id(copy, PERI_KIND_SET, 1) == set && peri_id(copy, PERI_KIND_MATERIAL, 1) == peri_id(b, PERI_KIND_MATERIAL, 1));
    peri_body_destroy(b);
    peri_body_destroy(copy);
}

/* ---- points -------------------------------------------------------------------------------------------------------- */

/* An allocator that has 100 MB at a time. */
static void *give_some(void *user, uint64_t bytes) { return bytes > 100000000 ? NULL : give(user, bytes); }

static void boxes_have_a_range(void) {
    const double lo[3] = {0, 0, 0}, small[3] = {300, 300, 0}, large[3] = {46341, 46340, 0}, huge[3] = {1e6, 1e6, 0}, thin[3] = {4, 0.2, 0};
    const double backwards[3] = {1, -1, 0};
    const int32_t none[1] = {0};
    peri_body_desc d;
    peri_body *b = NULL;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 3;
    d.allocate = give_some;
    d.release = take;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    const int32_t m = unbreakable(b, 1, 1);
    REFUSE(b, PERI_ERROR_EMPTY, peri_set_families(b, 1, none)); /* after all points were added */
    REFUSE(b, PERI_ERROR_RANGE, peri_add_box(b, m, lo, backwards, 1));
    AT_FAULT("hi", 1, -1);
    CHECK(peri_add_box(b, m, lo, thin, 1) == 4); /* at least one cell per axis */
    CHECK(peri_add_box(b, m, lo, small, 1) == 90000);
    REFUSE(b, PERI_ERROR_TOO_LARGE, peri_add_box(b, m, lo, huge, 1)); /* ids are 32 bits */
    AT_FAULT("spacing", -1, 1e12);
    REFUSE(b, PERI_ERROR_TOO_LARGE, peri_add_box(b, m, lo, large, 1)); /* each alone has room, both have not */
    AT_FAULT("points", -1, 46341.0 * 46340.0);
    CHECK(peri_point_count(b) == 90004);
    peri_body_destroy(b);
}

/* The spacing of a cloud is the edge of a cell of its mean volume: a displacement of 1e15 of them is none. */
static void clouds_have_a_spacing(void) {
    const double x[6] = {0, 0, 0.1, 0, 0.2, 0}, v[3] = {0.01, 0.01, 0.01}, far[2] = {0.9e14, 0}, further[2] = {1.1e14, 0};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 0.15);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 3, x, v, NULL));
    MUST(b, peri_build(b));
    MUST(b, peri_add_displacement(b, PERI_ALL, far));
    REFUSE(b, PERI_ERROR_RANGE, peri_add_displacement(b, PERI_ALL, further));
    peri_body_destroy(b);
}

/* ---- what comes out ------------------------------------------------------------------------------------------------ */

/* A view shows component k of point i at offset[k] + scale*data[...], all of it filled in. */
static void views_are_complete(void) {
    static const int32_t fields[4] = {PERI_FIELD_POSITION, PERI_FIELD_VOLUME, PERI_FIELD_DAMAGE, PERI_FIELD_STRAIN};
    const double lo[3] = {5, -7, 0}, hi[3] = {5.4, -6.6, 0};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 0.3);
    int n;
    MUST(b, peri_add_box(b, unbreakable(b, 1, 1), lo, hi, 0.1));
    MUST(b, peri_build(b));
    for (n = 0; n < 4; ++n) {
        double *copy = get(b, fields[n]);
        peri_view v;
        int64_t i;
        int32_t k;
        memset(&v, 0x55, sizeof v);
        MUST(b, peri_view_field(b, fields[n], &v));
        CHECK(v.type == PERI_TYPE_F64 && v.count == 16);
        for (i = 0; i < v.count; ++i)
            for (k = 0; k < v.components; ++k) {
                const double *data = (const double *)v.data + i * v.point_stride + k * v.component_stride;
                CHECK_NEAR(v.offset[k] + v.scale * *data, copy[i * v.components + k], 1e-15, 0);
            }
        if (n == 0) CHECK(copy[0] > 5 && copy[1] < -6.5);
        free(copy);
    }
    peri_body_destroy(b);
}

/* Momentum is density times volume times velocity, each point's by its own material; without a ledger nothing is accounted for. */
static void masses_are_of_the_materials(void) {
    const double x[6] = {0, 0, 1, 0, 2, 0}, volume[3] = {1, 2, 3}, v[2] = {0.5, -0.25}, rho[2] = {3, 7};
    peri_body_desc d;
    peri_body *b = NULL;
    double momentum[2], turn;
    peri_energy e;
    peri_body_desc_init(&d);
    d.space = PERI_SPACE_PLANE_STRESS;
    d.horizon = 1.5;
    d.ledger = 0;
    MUST(NULL, peri_body_create(&d, &b, NULL));
    const int32_t light = unbreakable(b, 1, rho[0]), heavy = unbreakable(b, 1, rho[1]), of[3] = {light, heavy, heavy};
    MUST(b, peri_add_points(b, 3, x, volume, of));
    MUST(b, peri_build(b));
    MUST(b, peri_add_velocity(b, PERI_ALL, v));
    MUST(b, peri_get_momentum(b, momentum, &turn));
    const double mass = rho[0] * 1 + rho[1] * 5;
    CHECK_NEAR(momentum[0], mass * v[0], 1e-14, 0);
    CHECK_NEAR(momentum[1], mass * v[1], 1e-14, 0);
    CHECK_NEAR(turn, v[1] * rho[1] * (1 * 2 + 2 * 3), 1e-14, 0); /* sum m (x v_y - y v_x), y = 0 */
    MUST(b, peri_get_energy(b, &e));
    CHECK_NEAR(e.kinetic, 0.5 * mass * (v[0] * v[0] + v[1] * v[1]), 1e-14, 0);
    CHECK(e.external == 0 && e.initial == 0 && e.error == 0);
    peri_body_destroy(b);
}

/* A file that cannot be opened, and one whose last bytes find no room: /dev/full takes none. */
static void files_may_fail(void) {
    peri_body *b = block(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 4, 4, 1);
    FILE *full = fopen("/dev/full", "wb");
    REFUSE(b, PERI_ERROR_WRITE, peri_export_vtu(b, "build/no_such_folder/x.vtu"));
    AT_FAULT("path", -1, 0);
    REFUSE(b, PERI_ERROR_WRITE, peri_export_history(b, "build/no_such_folder/x.csv", 0));
    AT_FAULT("path", -1, 0);
    if (full) {
        (void)fclose(full);
        REFUSE(b, PERI_ERROR_WRITE, peri_export_history(b, "/dev/full", 0)); /* a line waits for the close */
        AT_FAULT("path", -1, 0);
    }
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(numbers_are_written);
    RUN(errors_are_told);
    RUN(vectors_are_looked_at_whole);
    RUN(materials_name_what_is_wrong);
    RUN(interfaces_are_replaced);
    RUN(constants_have_a_range);
    RUN(tiny_normals_have_a_direction);
    RUN(bodies_name_what_is_wrong);
    RUN(sets_and_cracks_name_what_is_wrong);
    RUN(motion_has_a_range);
    RUN(cubes_have_a_range);
    RUN(forces_have_a_range);
    RUN(obstacles_have_a_range);
    RUN(contrasts_have_a_range);
    RUN(clones_have_the_ids);
    RUN(boxes_have_a_range);
    RUN(clouds_have_a_spacing);
    RUN(views_are_complete);
    RUN(masses_are_of_the_materials);
    RUN(files_may_fail);
    return test_end("test_survivors");
}
