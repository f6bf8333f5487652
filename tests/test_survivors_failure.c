/* SPDX-License-Identifier: MIT */
/* test_survivors_failure.c - what `make mutants` found that no other quick test of failure looked at.

   SOURCE OF TRUTH: what a step keeps up to date as bonds break must be what is made anew of the bonds that are left: cutting a bond that is
   broken already changes nothing, but has all of it made anew. Bonds counted one by one; conservation of momentum; the first law. */
#include "scene.h"

static int64_t broken_bonds(peri_body *b) {
    const int64_t n = peri_point_count(b);
    const int32_t width = peri_family_width(b);
    int32_t *rows = (int32_t *)malloc((size_t)(n * width) * sizeof *rows);
    int64_t i, k, count = 0;
    MUST(b, peri_get_families(b, 0, n, rows, n * width));
    for (i = 0; i < n; ++i)
        for (k = 0; k < width; ++k)
            if (rows[i * width + k] > i) {
                const int32_t whole = peri_bond_is_intact(b, (int32_t)i, rows[i * width + k]);
                CHECK(whole == peri_bond_is_intact(b, rows[i * width + k], (int32_t)i));
                count += !whole;
            }
    free(rows);
    return count;
}

/* A broken bond, to cut it again. */
static int find_broken(peri_body *b, int32_t *pair) {
    const int64_t n = peri_point_count(b);
    int32_t i, j;
    for (i = 0; i < n; ++i)
        for (j = i + 1; j < n; ++j)
            if (peri_bond_is_intact(b, i, j) == 0) {
                pair[0] = i;
                pair[1] = j;
                return 1;
            }
    return 0;
}

/* Two halves that part, one step after the other, as long as bonds break. */
static void steps_keep_up(int32_t law, int32_t criterion, int32_t kernel, double scatter) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 2.2, 20, 8, 1);
    const double lo[2] = {10, -1}, hi[2] = {21, 9}, v[2] = {0.3, 0.05};
    double start[2], now[2];
    int step, breaking = 0;
    s.desc.kernel = kernel;
    s.material.criterion = criterion;
    if (criterion == PERI_CRITERION_STRETCH) s.material.critical_stretch = 0.05;
    else s.material.fracture_energy = 4e-3;
    s.scatter = scatter;
    s.seed = 3;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), v));
    MUST(b, peri_get_momentum(b, start, NULL));
    for (step = 0; step < 14; ++step) {
        const int64_t before = peri_broken_count(b);
        int32_t pair[2];
        MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 0.15, 0));
        CHECK(peri_broken_count(b) == broken_bonds(b));
        breaking += peri_broken_count(b) > before;
        if (!find_broken(b, pair)) continue;
        double *kept = get(b, PERI_FIELD_FORCE_DENSITY), *damage = get(b, PERI_FIELD_DAMAGE);
        const double stable = peri_stable_step(b), size = largest(kept, 320);
        int k;
        CHECK(peri_cut_pairs(b, PERI_CUT_NOW, 1, pair) == 0); /* nothing changes */
        double *anew = get(b, PERI_FIELD_FORCE_DENSITY);
        for (k = 0; k < 320; ++k) CHECK(fabs(kept[k] - anew[k]) <= 1e-11 * size);
        CHECK_NEAR(peri_stable_step(b), stable, 1e-11, 0);
        CHECK(largest(damage, 160) > 0);
        free(kept);
        free(anew);
        free(damage);
    }
    CHECK(breaking > (criterion == PERI_CRITERION_STRETCH)); /* in steps after the first, too */
    MUST(b, peri_get_momentum(b, now, NULL));
    CHECK_NEAR(now[0], start[0], 1e-12, 0);
    CHECK_NEAR(now[1], start[1], 0, 1e-12 * start[0]);
    peri_body_destroy(b);
}

static void steps_keep_all_up_to_date(void) {
    static const int32_t laws[3] = {PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};
    static const int32_t criteria[3] = {PERI_CRITERION_STRETCH, PERI_CRITERION_BOND_ENERGY, PERI_CRITERION_NODE_ENERGY};
    int k, n;
    for (k = 0; k < 3; ++k) {
        for (n = 0; n < 3; ++n) steps_keep_up(laws[k], criteria[n], PERI_KERNEL_BEST, 0);
        steps_keep_up(laws[k], PERI_CRITERION_STRETCH, PERI_KERNEL_LIST, 0);
        steps_keep_up(laws[k], PERI_CRITERION_STRETCH, PERI_KERNEL_BEST, 0.6); /* a list whose places are not ids */
    }
    steps_keep_up(PERI_LAW_LPS, PERI_CRITERION_BOND_ENERGY, PERI_KERNEL_REFERENCE, 0);
}

/* The only bond that breaks joins the last point of one block and the first of the next. */
static void single_bonds_break_across_blocks(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 0.2, 1, 1.2, 128, 1, 1);
    const double apart[2] = {0.5, 0}, lo[2] = {64, -1}, hi[2] = {129, 2};
    s.material.critical_stretch = 0.1;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_add_displacement(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), apart));
    MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, 1, 1e-3, 0));
    CHECK(peri_broken_count(b) == 1 && peri_bond_is_intact(b, 63, 64) == 0 && peri_bond_is_intact(b, 64, 63) == 0);
    peri_body_destroy(b);
}

/* The first law: what the ledger leaves open falls with the square of the time step, through fracture, too. */
static double left_open(int32_t law, double dt) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 2.2, 12, 6, 1);
    const double lo[2] = {6, -1}, hi[2] = {13, 9}, v[2] = {0.3, 0.05};
    peri_energy e;
    s.material.critical_stretch = 0.06;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_add_velocity(b, (int32_t)MUST(b, peri_select_box(b, NULL, lo, hi)), v));
    MUST(b, go(b, PERI_INTEGRATOR_VELOCITY_VERLET, (int64_t)(1.2 / dt + 0.5), dt, 0));
    MUST(b, peri_get_energy(b, &e));
    CHECK(e.fracture > 1e-3 * e.initial && peri_broken_count(b) > 0);
    peri_body_destroy(b);
    return fabs(e.error) / e.initial;
}

static void fracture_is_paid_for(void) {
    static const int32_t laws[4] = {PERI_LAW_BOND_BASED, PERI_LAW_LPS, PERI_LAW_OTERKUS, PERI_LAW_CORRESPONDENCE};
    int k;
    for (k = 0; k < 4; ++k) {
        const double coarse = left_open(laws[k], 0.02), fine = left_open(laws[k], 0.01);
        CHECK(fine < 1e-5 && fine < coarse); /* what fracture takes is a hundred times more */
        if (k < 3) CHECK(fine < 0.3 * coarse); /* of correspondence, under which few bonds break, both are below 1e-8 */
    }
}

/* sum |xi|^2 A over the cells around one, A the part of the unit cell at xi within 3 of it, by strips. */
static double moment_within_three(void) {
    const int strips = 4000;
    double sum = 0;
    int i, j, k;
    for (i = -3; i <= 3; ++i)
        for (j = -3; j <= 3; ++j)
            for (k = 0; k < strips; ++k) {
                const double x = abs(i) - 0.5 + (k + 0.5) / strips, half = x < 3 ? sqrt(9 - x * x) : 0;
                sum += (i * i + j * j) * (j == 0 ? 2 * fmin(half, 0.5) : fmax(0, fmin(half, abs(j) + 0.5) - abs(j) + 0.5)) / strips;
            }
    return sum;
}

/* Work and limit of a bond both go with the part of its partner that is inside the horizon: broken or not is a matter of its stretch and
   length alone. LPS at nu = 1/3 in plane stress has no part of the dilatation: in a whole family an even stretch s does the work K s^2 xi^2
   on a bond, and sum K s^2 xi^2 V/2 = 2 bulk s^2. A limit between the lengths sqrt(8) and 3 parts the bonds half inside, and no shorter. */
static void partial_bonds_take_the_same_energy(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 1.0 / 3, 1, 3, 20, 20, 1);
    const double bulk = 0.75, m = moment_within_three(); /* E/(2 - 2 nu) */
    double w0, u[2 * 400];
    int32_t i, j;
    int inside = 0;
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    s.material.fracture_energy = 1e-3;
    peri_body *b = specimen_make(&s);
    MUST(b, peri_get_critical_energy(b, peri_id(b, PERI_KIND_MATERIAL, 1), &w0));
    const double stretch = sqrt(w0 * m / (4 * bulk * 8.9));
    double *x = get(b, PERI_FIELD_POSITION);
    peri_evaluate_desc e;
    peri_evaluate_desc_init(&e);
    for (i = 0; i < 2 * 400; ++i) u[i] = stretch * x[i];
    e.displacement = u;
    e.fracture = 1;
    MUST(b, peri_evaluate(b, &e, NULL));
    for (i = 0; i < 400; ++i)
        for (j = i + 1; j < 400; ++j) {
            const double length = hypot(x[2 * i] - x[2 * j], x[2 * i + 1] - x[2 * j + 1]);
            const double *p = &x[2 * i], *q = &x[2 * j];
            const int outside = fabs(p[0] - 10) > 5 || fabs(p[1] - 10) > 5 || fabs(q[0] - 10) > 5 || fabs(q[1] - 10) > 5;
            if (outside || length > 3.1) continue;
            CHECK(peri_bond_is_intact(b, i, j) == (length < 2.9));
            inside += length > 2.9;
        }
    CHECK(inside == 2 * 7 * 10);
    free(x);
    peri_body_destroy(b);
}

static int32_t stretch_evenly(void *user, double factor, int64_t count, const int32_t *points, double *value) {
    int64_t k;
    for (k = 0; k < count; ++k) {
        value[2 * k] = factor * ((const double *)user)[2 * points[k]];
        value[2 * k + 1] = factor * ((const double *)user)[2 * points[k] + 1];
    }
    return 0;
}

static int32_t note_first(void *user, peri_body *b) {
    double *first = (double *)user;
    if (*first == 0) *first = peri_load_factor(b);
    return 0;
}

/* Under the control of fracture the first of those bonds break as the body is stretched to where K s^2 13 = w0, not before and not after;
   the points near the edge, whose families lack something, do not break. */
static void control_finds_the_first_bond(void) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_LPS, 1.0 / 3, 1, 3, 20, 20, 1);
    static const double edge[4][4] = {{0, 0, 5, 20}, {15, 0, 20, 20}, {0, 0, 20, 5}, {0, 15, 20, 20}};
    const double bulk = 0.75, m = moment_within_three();
    double w0, first = 0;
    int k;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.quadrature = PERI_QUADRATURE_PARTIAL;
    s.material.criterion = PERI_CRITERION_BOND_ENERGY;
    s.material.fracture_energy = 1e-3;
    peri_body *b = specimen_make(&s);
    double *x = get(b, PERI_FIELD_POSITION);
    peri_solve_desc st;
    for (k = 0; k < 4; ++k) MUST(b, peri_set_no_fail(b, (int32_t)MUST(b, peri_select_box(b, NULL, edge[k], edge[k] + 2)), 1));
    MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, stretch_evenly, x));
    MUST(b, peri_get_critical_energy(b, peri_id(b, PERI_KIND_MATERIAL, 1), &w0));
    const double stretch = sqrt(w0 * m / (4 * bulk * 13)); /* the longest, a corner of whose cells is within reach */
    peri_solve_desc_init(&st);
    st.control = PERI_CONTROL_FRACTURE;
    st.load_to = 2 * stretch;
    st.breaks = 1;
    st.on_step = note_first;
    st.user = &first;
    MUST(b, peri_solve(b, &st, NULL));
    CHECK_NEAR(first, stretch, 1e-4, 0);
    free(x);
    peri_body_destroy(b);
}

/* A bond that was made stronger, and named from either end, holds where all others of its length break. */
static void strong_bonds_hold_from_both_ends(void) {
    static const int32_t pairs[2][2] = {{3, 4}, {9, 8}};
    const double factors[2] = {3, 3};
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0.25, 1, 1.2, 14, 1, 1);
    double u[2 * 14];
    int i;
    s.material.critical_stretch = 0.01;
    peri_body *b = specimen_make(&s);
    CHECK(MUST(b, peri_set_strength_pairs(b, 2, &pairs[0][0], factors)) == 2);
    peri_evaluate_desc e;
    peri_evaluate_desc_init(&e);
    for (i = 0; i < 14; ++i) u[2 * i] = 0.02 * i, u[2 * i + 1] = 0;
    e.displacement = u;
    e.fracture = 1;
    MUST(b, peri_evaluate(b, &e, NULL));
    for (i = 0; i < 13; ++i) CHECK(peri_bond_is_intact(b, i, i + 1) == (i == 3 || i == 8));
    peri_body_destroy(b);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(steps_keep_all_up_to_date);
    RUN(single_bonds_break_across_blocks);
    RUN(fracture_is_paid_for);
    RUN(partial_bonds_take_the_same_energy);
    RUN(control_finds_the_first_bond);
    RUN(strong_bonds_hold_from_both_ends);
    return test_end("test_survivors_failure");
}
