/* SPDX-License-Identifier: MIT */
/* test_survivors_points.c - what `make mutants` found that no other quick test looked at: given families, twins, influence functions.

   SOURCE OF TRUTH: peri.h and docs/manual.md, which say of each status what index and value name; sizes of w beyond 1e100 are infinite,
   below 1e-100 nothing, and sums of w over a family have a range, too. */
#include "refusal.h"

#define RECORD_IS(name, at, number) CHECK(strcmp(seen.field, name) == 0 && seen.index == (at) && seen.value == (number))

/* Four points in a row, the first of which is at x0. */
static peri_body *row_of_four(double x0) {
    const double x[8] = {x0, 0, 1, 0, 2, 0, 3, 0}, v[4] = {1, 1, 1, 1};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 4, x, v, NULL));
    return b;
}

/* The index of PERI_ERROR_IBOND is an entry, its value the number there. */
static void given_families_are_checked(void) {
    const int32_t beyond[8] = {1, 0, 0, 2, 1, 4, 2, 3}, negative[8] = {1, 0, 0, 2, 1, -1, 2, 3};
    const int32_t twice[12] = {1, 0, 0, 0, 2, 0, 1, 3, 2, 2, 3, 3}, alone[8] = {1, 0, 0, 2, 1, 3, 3, 3};
    const int32_t good[8] = {1, 0, 0, 2, 1, 3, 2, 3};
    const double x[2] = {4, 0}, v[1] = {1};
    peri_body *b = row_of_four(0);
    MUST(b, peri_set_families(b, 2, beyond));
    REFUSE(b, PERI_ERROR_IBOND, peri_build(b));
    RECORD_IS("ibond", 5, 4);
    MUST(b, peri_set_families(b, 2, negative));
    REFUSE(b, PERI_ERROR_IBOND, peri_build(b));
    RECORD_IS("ibond", 5, -1);
    MUST(b, peri_set_families(b, 3, twice)); /* row 1 has 0 at entries 3 and 5 */
    REFUSE(b, PERI_ERROR_IBOND, peri_build(b));
    RECORD_IS("ibond", 5, 0);
    MUST(b, peri_set_families(b, 2, alone)); /* 3 is in row 2, but 2 not in row 3 */
    REFUSE(b, PERI_ERROR_IBOND, peri_build(b));
    RECORD_IS("ibond", 5, 3);
    MUST(b, peri_set_families(b, 2, good));
    MUST(b, peri_add_points(b, 1, x, v, NULL)); /* after the families: there are too few of them */
    REFUSE(b, PERI_ERROR_IBOND, peri_build(b));
    RECORD_IS("ibond", -1, 8);
    peri_body_destroy(b);
    b = row_of_four(0);
    MUST(b, peri_set_families(b, 2, good));
    MUST(b, peri_build(b));
    CHECK(peri_bond_count(b) == 3);
    peri_body_destroy(b);
    b = row_of_four(1);
    MUST(b, peri_set_families(b, 2, good));
    REFUSE(b, PERI_ERROR_COINCIDENT, peri_build(b));
    RECORD_IS("positions", 1, 0);
    peri_body_destroy(b);
}

/* A trillionth of the spacing is the same place; the record names the first point that has another there, and the least of these. */
static void twins_are_found(void) {
    const double x[10] = {0, 0, 1, 0, 2, 0, 1 + 1e-13, 0, 1, 1e-13}, v[5] = {1, 1, 1, 1, 1}, near[4] = {0, 0, 1e-3, 0};
    peri_body *b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 5, x, v, NULL));
    REFUSE(b, PERI_ERROR_COINCIDENT, peri_build(b));
    RECORD_IS("positions", 3, 1);
    peri_body_destroy(b);
    b = empty(PERI_SPACE_PLANE_STRESS, PERI_PRECISION_DOUBLE, PERI_GEOMETRY_LINEAR, 1.5);
    (void)unbreakable(b, 1, 1);
    MUST(b, peri_add_points(b, 2, near, v, NULL));
    MUST(b, peri_build(b));
    peri_body_destroy(b);
}

typedef struct influence {
    double inner, outer; /* w below and above half the horizon */
    int32_t said, power;
} influence;

static int32_t weigh(void *user, double q, double *w) {
    const influence *f = (const influence *)user;
    *w = (q < 0.6 ? f->inner : f->outer) / pow(q, f->power);
    return f->said;
}

static int32_t build_with(influence f, int32_t law, int32_t precision) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.3, 1, 2.2, 5, 5, 1);
    peri_error e;
    s.desc.influence = PERI_INFLUENCE_USER;
    s.desc.influence_fn = weigh;
    s.desc.influence_user = &f;
    s.desc.precision = precision;
    peri_body *b = specimen_start(&s);
    MUST(b, peri_add_box(b, peri_id(b, PERI_KIND_MATERIAL, 1), s.lo, s.hi, 1));
    const int32_t status = peri_build(b);
    CHECK(peri_get_error(b, &e) == PERI_OK && e.code == status);
    if (status == PERI_ERROR_CALLBACK) CHECK(strcmp(e.field, "peri_influence_fn") == 0 && e.value == f.said);
    peri_body_destroy(b);
    return status;
}

static void influences_have_a_range(void) {
    const influence plain = {1, 1, 0, 0}, fails = {1, 1, -1, 0}, fails_hard = {1, 1, -7, 0}, faint = {1e-101, 1e-101, 0, 0};
    const influence strong = {5e99, 5e99, 0, 0}, middling = {1e32, 1e32, 0, 0}, signs = {0.1, -1, 0, 0}, steep = {1, 1, 0, 4};
    CHECK(build_with(plain, PERI_LAW_LPS, PERI_PRECISION_DOUBLE) == PERI_OK);
    CHECK(build_with(fails, PERI_LAW_LPS, PERI_PRECISION_DOUBLE) == PERI_ERROR_CALLBACK);
    CHECK(build_with(fails_hard, PERI_LAW_LPS, PERI_PRECISION_DOUBLE) == PERI_ERROR_CALLBACK);
    CHECK(build_with(faint, PERI_LAW_LPS, PERI_PRECISION_DOUBLE) == PERI_ERROR_FAMILY); /* none has a weight */
    CHECK(build_with(strong, PERI_LAW_LPS, PERI_PRECISION_DOUBLE) == PERI_ERROR_INFLUENCE); /* 5e99 each, 1e100 together */
    CHECK(build_with(middling, PERI_LAW_LPS, PERI_PRECISION_DOUBLE) == PERI_OK);
    CHECK(build_with(middling, PERI_LAW_LPS, PERI_PRECISION_MIXED) == PERI_ERROR_INFLUENCE);
    CHECK(build_with(signs, PERI_LAW_LPS, PERI_PRECISION_DOUBLE) == PERI_ERROR_INFLUENCE); /* sum w |xi|^2 is negative */
    CHECK(build_with(steep, PERI_LAW_BOND_BASED, PERI_PRECISION_DOUBLE) == PERI_ERROR_INFLUENCE); /* no finite moment */
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(given_families_are_checked);
    RUN(twins_are_found);
    RUN(influences_have_a_range);
    return test_end("test_survivors_points");
}
