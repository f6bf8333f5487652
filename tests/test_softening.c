/* SPDX-License-Identifier: MIT */
/* test_softening.c - bonds that soften by a table: energy, strength, unloading, equilibria and motion.

   SOURCE OF TRUTH: what was given: the strength is the largest stress of a bar in uniform tension, the fracture energy what a wider strip
   takes more when it is torn apart; the area under piecewise linear curves, by hand; central differences of the forces; conservation of
   momentum and energy; that clones, checkpoints and reset repeat. */
#include "specimen.h"

#define YOUNG    2.0
#define STRENGTH 2e-3

static const double kinks[8] = {0, 1, 0.15, 0.6, 0.5, 0.25, 1, 0}; /* a plateau would soften all of a strip, not its crack alone */

static peri_softening_desc soft(int32_t shape, double energy) {
    peri_softening_desc d;
    peri_softening_desc_init(&d, shape);
    d.strength = STRENGTH;
    d.fracture_energy = energy;
    d.count = shape == PERI_SOFTENING_TABLE ? 4 : 0;
    d.table = shape == PERI_SOFTENING_TABLE ? kinks : NULL;
    return d;
}

/* A strip along x, plane stress, linear, grips of `grip` points at both ends of `length`, which do not fail. */
typedef struct strip {
    peri_body *body;
    int32_t    material, left, right, load;
} strip;

static strip strip_of(double reach, int length, int width, int grip, int32_t correction, const peri_softening_desc *d) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, reach, length + 2 * grip, width, 1);
    const double end[2] = {grip, width}, start[2] = {length + grip, 0};
    strip r = {0};
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.desc.correction = correction;
    s.material.young = YOUNG;
    r.body = specimen_start(&s);
    r.material = peri_id(r.body, PERI_KIND_MATERIAL, 1);
    CHECK(MUST(r.body, peri_set_softening(r.body, r.material, r.material, d)) == PERI_OK);
    (void)MUST(r.body, peri_add_box(r.body, r.material, s.lo, s.hi, 1));
    (void)MUST(r.body, peri_build(r.body));
    r.left = (int32_t)MUST(r.body, peri_select_box(r.body, NULL, s.lo, end));
    r.right = (int32_t)MUST(r.body, peri_select_box(r.body, NULL, start, s.hi));
    (void)MUST(r.body, peri_set_no_fail(r.body, r.left, 1));
    (void)MUST(r.body, peri_set_no_fail(r.body, r.right, 1));
    return r;
}

/* ---- what was given is found ------------------------------------------------------------------------------------------ */

/* What tearing a notched strip takes; its free edge and its notch cost the same at any width. */
static double torn(int32_t shape, double reach, int width, double energy) {
    const peri_softening_desc d = soft(shape, energy);
    const int grip = (int)(2 * reach), length = 4 * (int)reach;
    const double middle = grip + 0.5 * length, mouth[2] = {middle, -1}, tip[2] = {middle, (int)reach};
    strip s = strip_of(reach, length, width, grip, PERI_CORRECTION_NONE, &d);
    double last;
    peri_solve_desc st;
    peri_energy e;
    (void)MUST(s.body, peri_get_softening(s.body, s.material, s.material, NULL, &last));
    const double pull[2] = {1.2 * last * reach * reach, 0}; /* the longest bonds across lie aslant */
    (void)MUST(s.body, peri_cut_segment(s.body, PERI_CUT_INITIAL, mouth, tip));
    (void)MUST(s.body, peri_prescribe_displacement(s.body, s.left, PERI_AXIS_XY, NULL, NULL, NULL));
    (void)MUST(s.body, peri_prescribe_displacement(s.body, s.right, PERI_AXIS_XY, pull, NULL, NULL));
    peri_solve_desc_init(&st);
    for (int part = 0; part < 2; ++part) { /* the peak comes early */
        st.load_to = part ? 1 : 0.03;
        st.steps = part ? 3 : 4;
        (void)MUST(s.body, peri_solve(s.body, &st, NULL));
    }
    (void)MUST(s.body, peri_get_energy(s.body, &e));
    CHECK(e.elastic < 1e-9 * e.fracture && e.fracture <= e.external * (1 + 1e-9) + fabs(e.error));
    peri_body_destroy(s.body);
    return e.fracture;
}

/* A characteristic length E G/strength^2 of 3000 spacings: little is lost away from the crack. */
static void takes_energy(int32_t shape, double reach, int narrow, int wide) {
    const double energy = 3000 * STRENGTH * STRENGTH / YOUNG;
    const double more = torn(shape, reach, wide, energy) - torn(shape, reach, narrow, energy);
    CHECK_NEAR(more, energy * (wide - narrow), 0.05, 0);
}

static void bilinear_takes_its_energy(void) { takes_energy(PERI_SOFTENING_BILINEAR, 3.015, 9, 11); }
static void tables_take_their_energy(void) { takes_energy(PERI_SOFTENING_TABLE, 2.015, 6, 8); }
static void all_shapes_take_their_energy(void) {
    for (int32_t shape = PERI_SOFTENING_BILINEAR; shape <= PERI_SOFTENING_TABLE; ++shape) {
        takes_energy(shape, 3.015, 10, 16);
        takes_energy(shape, 5.015, 16, 24);
    }
}

/* The largest stress of a wide bar, both ends free to get narrower. */
static double bar_strength(int32_t shape, double reach, int width, double length) {
    const peri_softening_desc d = soft(shape, length * STRENGTH * STRENGTH / YOUNG);
    strip s = strip_of(reach, 4 * (int)reach, width, 2, PERI_CORRECTION_MOMENT, &d);
    const double from[2] = {0, 0}, pull[2] = {8e-3 * (4 * (int)reach + 2), 0};
    double curve[40][6], most = 0;
    peri_solve_desc st;
    (void)MUST(s.body, peri_prescribe_displacement(s.body, s.left, PERI_AXIS_X, NULL, NULL, NULL));
    (void)MUST(s.body, peri_prescribe_displacement(s.body, peri_select_ball(s.body, NULL, from, 1), PERI_AXIS_Y, NULL, NULL, NULL));
    s.load = (int32_t)MUST(s.body, peri_prescribe_displacement(s.body, s.right, PERI_AXIS_X, pull, NULL, NULL));
    peri_solve_desc_init(&st);
    st.steps = 8;
    st.load_to = shape == PERI_SOFTENING_BILINEAR && length < 100 ? 0.35 : 0.6;
    st.tolerance = 1e-6;
    st.curve_load = s.load;
    st.curve = curve[0];
    st.curve_rows = 40;
    (void)peri_solve(s.body, &st, NULL);
    for (int k = 0; k < 8; ++k) most = fmax(most, curve[k][3] / width);
    peri_body_destroy(s.body);
    return most;
}

static void strength_is_that_of_a_bar(void) {
    CHECK_NEAR(bar_strength(PERI_SOFTENING_BILINEAR, 3.015, 36, 60), STRENGTH, 0.01, 0);
}

/* ---- one bond ---------------------------------------------------------------------------------------------------------- */

typedef struct pair {
    peri_body *body;
    double     first, last, unit; /* the stretches of its law; force on one point at stretch 1, were the bond linear      */
} pair;

static pair pair_of(int32_t shape, int32_t unloading, double compression) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 1.2, 2, 1, 1);
    peri_softening_desc d = soft(shape, 6e-6);
    pair p = {0};
    double c;
    d.unloading = unloading;
    d.compression = compression;
    s.desc.geometry = PERI_GEOMETRY_LINEAR;
    s.material.young = YOUNG;
    p.body = specimen_start(&s);
    const int32_t m = peri_id(p.body, PERI_KIND_MATERIAL, 1);
    (void)MUST(p.body, peri_get_bond_constants(p.body, m, m, &c, NULL));
    (void)MUST(p.body, peri_set_softening(p.body, m, m, &d));
    (void)MUST(p.body, peri_add_box(p.body, m, s.lo, s.hi, 1));
    (void)MUST(p.body, peri_build(p.body));
    (void)MUST(p.body, peri_get_softening(p.body, m, m, &p.first, &p.last));
    p.unit = c;
    return p;
}

/* Takes the bond to a stretch, for good; returns its force over that of a linear bond of stretch 1. */
static double pull_to(const pair *p, double stretch) {
    const double u[4] = {0, 0, stretch, 0};
    double f[4];
    peri_evaluate_desc d;
    peri_evaluate_desc_init(&d);
    d.displacement = u;
    d.force = f;
    d.fracture = 1;
    d.external = 0;
    (void)MUST(p->body, peri_evaluate(p->body, &d, NULL));
    CHECK(f[0] == -f[2] && f[1] == 0 && f[3] == 0);
    return f[0] / p->unit;
}

static double lost(const pair *p) {
    peri_energy e;
    (void)MUST(p->body, peri_get_energy(p->body, &e));
    return e.fracture / p->unit;
}

static double held(const pair *p) {
    peri_energy e;
    (void)MUST(p->body, peri_get_energy(p->body, &e));
    return e.elastic / p->unit;
}

/* Bilinear: F = a (b - s)/(b - a), below it a triangle and a trapezium. */
static void one_bond_follows_its_curve(void) {
    for (int elastic = 0; elastic < 2; ++elastic) {
        pair p = pair_of(PERI_SOFTENING_BILINEAR, elastic ? PERI_UNLOADING_ELASTIC : PERI_UNLOADING_SECANT, 0.5);
        const double a = p.first, b = p.last, s = 0.4 * a + 0.6 * b, f = a * (b - s) / (b - a);
        const double area = 0.5 * a * a + 0.5 * (a + f) * (s - a);
        CHECK(a > 0 && b > 2 * a);
        CHECK_NEAR(pull_to(&p, 0.9 * a), 0.9 * a, 1e-12, 0);
        CHECK_NEAR(pull_to(&p, -0.9 * a), -0.45 * a, 1e-12, 0);
        CHECK_NEAR(held(&p), 0.5 * 0.5 * 0.81 * a * a, 1e-12, 0);
        CHECK(lost(&p) == 0);
        CHECK_NEAR(pull_to(&p, s), f, 1e-10, 0);
        CHECK_NEAR(held(&p), elastic ? 0.5 * f * f : 0.5 * f * s, 1e-10, 0);
        CHECK_NEAR(lost(&p), area - (elastic ? 0.5 * f * f : 0.5 * f * s), 1e-10, 0);
        CHECK_NEAR(pull_to(&p, s - 0.3 * f), elastic ? 0.7 * f : f * (1 - 0.3 * f / s), 1e-10, 0);
        CHECK_NEAR(pull_to(&p, -0.1 * a), elastic ? 0.5 * (f - s - 0.1 * a) : -0.05 * a, 1e-10, 0);
        CHECK_NEAR(lost(&p), area - (elastic ? 0.5 * f * f : 0.5 * f * s), 1e-10, 0);
        CHECK_NEAR(pull_to(&p, s), f, 1e-10, 0);
        CHECK(pull_to(&p, b * 1.01) == 0 && peri_broken_count(p.body) == 1);
        CHECK_NEAR(lost(&p), 0.5 * a * b, 1e-10, 0);
        CHECK(pull_to(&p, -a) == 0);
        peri_body_destroy(p.body);
    }
}

/* Any way to and fro: nothing is won, and what was put in is held or lost. */
static void cycles_never_win(void) {
    uint64_t seed = 7;
    for (int elastic = 0; elastic < 2; ++elastic)
        for (int32_t shape = PERI_SOFTENING_BILINEAR; shape <= PERI_SOFTENING_TABLE; ++shape) {
            pair p = pair_of(shape, elastic ? PERI_UNLOADING_ELASTIC : PERI_UNLOADING_SECANT, 1);
            double at = 0, work = 0, before = 0, force = 0;
            for (int turn = 0; turn < 12; ++turn) {
                const double to = (test_random(&seed) * 1.1 - 0.1) * p.last * (turn + 1) / 12;
                for (int k = 1; k <= 200; ++k) {
                    const double s = at + (to - at) * k / 200, f = pull_to(&p, s);
                    work += 0.5 * (f + force) * (to - at) / 200;
                    force = f;
                }
                at = to;
                CHECK(lost(&p) >= before);
                before = lost(&p);
                CHECK_NEAR(held(&p) + before, work, 0.01, 1e-12);
            }
            peri_body_destroy(p.body);
        }
}

static void too_large_a_horizon_is_said(void) {
    specimen s = specimen_of(PERI_SPACE_SOLID, PERI_LAW_BOND_BASED, 0, 1, 2.1, 6, 6, 6);
    peri_softening_desc d = soft(PERI_SOFTENING_BILINEAR, 0.1 * STRENGTH * STRENGTH / YOUNG);
    double first, last;
    s.material.young = YOUNG;
    peri_body *b = specimen_start(&s);
    const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
    CHECK(peri_set_softening(b, m, m, &d) == PERI_BRITTLE);
    (void)MUST(b, peri_add_box(b, m, s.lo, s.hi, 1));
    (void)MUST(b, peri_build(b));
    CHECK(peri_get_softening(b, m, m, &first, &last) == PERI_BRITTLE);
    CHECK(first == last && first < STRENGTH / YOUNG);
    peri_body_destroy(b);
}

/* ---- the tangent ------------------------------------------------------------------------------------------------------- */

static void forces_at(peri_body *b, const double *u, double *f) {
    peri_evaluate_desc d;
    peri_evaluate_desc_init(&d);
    d.displacement = u;
    d.force = f;
    d.nodal = 1;
    d.external = 0;
    (void)MUST(b, peri_evaluate(b, &d, NULL));
}

/* A body that has softened somewhat, at another place, against central differences; and the assembled matrix. */
static void tangent_is_the_derivative(int32_t geometry, int32_t space) {
    const int dim = space == PERI_SPACE_SOLID ? 3 : 2;
    specimen s = specimen_of(space, PERI_LAW_BOND_BASED, 0, 1, dim == 3 ? 1.8 : 3.015, 5, 5, 5);
    peri_softening_desc d = soft(PERI_SOFTENING_TRILINEAR, 200 * STRENGTH * STRENGTH / YOUNG);
    double u[375], v[375], up[375], plus[375], minus[375], k[375], size = 0, worst = 0;
    uint64_t seed = 3;
    s.desc.geometry = geometry;
    s.material.young = YOUNG;
    s.desc.thickness = 2;
    peri_body *b = specimen_start(&s);
    const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
    (void)MUST(b, peri_set_softening(b, m, m, &d));
    (void)MUST(b, peri_add_box(b, m, s.lo, s.hi, 1));
    (void)MUST(b, peri_build(b));
    const int n = (int)peri_point_count(b) * dim;
    for (int q = 0; q < n; ++q) {
        u[q] = 0.02 * test_random(&seed);
        v[q] = test_random(&seed) - 0.5;
    }
    peri_evaluate_desc e;
    peri_evaluate_desc_init(&e);
    e.displacement = u;
    e.fracture = 1;
    (void)MUST(b, peri_evaluate(b, &e, NULL));
    for (int q = 0; q < n; ++q) u[q] *= q % 3 ? 1.3 : 0.6;
    (void)MUST(b, peri_multiply_stiffness_at(b, u, v, k, n));
    for (int q = 0; q < n; ++q) up[q] = u[q] + 1e-8 * v[q];
    forces_at(b, up, plus);
    for (int q = 0; q < n; ++q) up[q] = u[q] - 1e-8 * v[q];
    forces_at(b, up, minus);
    for (int q = 0; q < n; ++q) {
        size = fmax(size, fabs(k[q]));
        worst = fmax(worst, fabs(k[q] + (plus[q] - minus[q]) / 2e-8));
    }
    CHECK(worst < 1e-6 * size);
    peri_body_destroy(b);
}

static void tangents_are_derivatives(void) {
    tangent_is_the_derivative(PERI_GEOMETRY_LINEAR, PERI_SPACE_PLANE_STRESS);
    tangent_is_the_derivative(PERI_GEOMETRY_NONLINEAR, PERI_SPACE_PLANE_STRAIN);
    tangent_is_the_derivative(PERI_GEOMETRY_NONLINEAR, PERI_SPACE_SOLID);
}

/* ---- motion ------------------------------------------------------------------------------------------------------------ */

static peri_body *flying(int32_t precision, int32_t unloading) {
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, PERI_LAW_BOND_BASED, 0, 1, 3.015, 10, 7, 1);
    peri_softening_desc d = soft(PERI_SOFTENING_BILINEAR, 60 * STRENGTH * STRENGTH / YOUNG);
    const double half[2] = {5, 7}, fast[2] = {0.03, 0.01};
    s.desc.precision = precision;
    s.material.young = YOUNG;
    d.unloading = unloading;
    peri_body *b = specimen_start(&s);
    const int32_t m = peri_id(b, PERI_KIND_MATERIAL, 1);
    (void)MUST(b, peri_set_softening(b, m, m, &d));
    (void)MUST(b, peri_add_box(b, m, s.lo, s.hi, 1));
    (void)MUST(b, peri_build(b));
    (void)MUST(b, peri_add_velocity(b, peri_select_box(b, NULL, s.lo, half), fast));
    return b;
}

static void run(peri_body *b, int64_t steps, double step) {
    peri_advance_desc a;
    peri_advance_desc_init(&a);
    a.steps = steps;
    a.time_step = step;
    (void)MUST(b, peri_advance(b, &a));
}

/* A block that tears itself in two: momentum stays, and the ledger closes the better the shorter the steps. */
static void motion_conserves(void) {
    double left[2], at[2], before[2];
    for (int k = 0; k < 2; ++k) {
        peri_body *b = flying(PERI_PRECISION_DOUBLE, k ? PERI_UNLOADING_ELASTIC : PERI_UNLOADING_SECANT);
        peri_energy e;
        for (int fine = 0; fine < 2; ++fine) {
            const double step = (fine ? 0.1 : 0.2) * peri_stable_step(b);
            if (fine) {
                const double half[2] = {5, 7}, fast[2] = {0.03, 0.01}, none[2] = {0, 0};
                (void)MUST(b, peri_reset(b));
                (void)MUST(b, peri_add_velocity(b, peri_select_box(b, NULL, none, half), fast));
            }
            (void)MUST(b, peri_get_momentum(b, before, NULL));
            run(b, fine ? 2400 : 1200, step);
            (void)MUST(b, peri_get_momentum(b, at, NULL));
            (void)MUST(b, peri_get_energy(b, &e));
            CHECK_NEAR(at[0], before[0], 1e-12, 0);
            CHECK_NEAR(at[1], before[1], 1e-12, 0);
            left[fine] = fabs(e.error);
            CHECK(e.fracture > 0.05 * e.initial && peri_broken_count(b) > 0);
            CHECK_NEAR(e.initial, e.kinetic + e.elastic + e.fracture + e.error, 1e-12, 0);
            CHECK(!fine || left[fine] < 1e-3 * e.initial);
        }
        CHECK(left[1] < 0.35 * left[0]); /* as the square of the step */
        peri_body_destroy(b);
    }
}

static void same_motion(peri_body *a, peri_body *b) {
    double u[2][140];
    peri_energy e[2];
    (void)MUST(a, peri_get_field(a, PERI_FIELD_DISPLACEMENT, u[0], 140));
    (void)MUST(b, peri_get_field(b, PERI_FIELD_DISPLACEMENT, u[1], 140));
    CHECK(memcmp(u[0], u[1], sizeof u[0]) == 0);
    (void)MUST(a, peri_get_energy(a, &e[0]));
    (void)MUST(b, peri_get_energy(b, &e[1]));
    CHECK(e[0].fracture == e[1].fracture && e[0].elastic == e[1].elastic && e[0].fracture > 0);
}

static char bytes[400000];
static int64_t written, taken;
static int32_t keep(void *user, const void *from, int64_t count) {
    (void)user;
    if (written + count > (int64_t)sizeof bytes) return 1;
    memcpy(bytes + written, from, (size_t)count);
    written += count;
    return 0;
}
static int32_t take(void *user, void *to, int64_t count) {
    (void)user;
    if (taken + count > written) return 1;
    memcpy(to, bytes + taken, (size_t)count);
    taken += count;
    return 0;
}

/* History goes with clones and checkpoints, and is forgotten by reset. */
static void history_is_kept(void) {
    static const int32_t precisions[3] = {PERI_PRECISION_DOUBLE, PERI_PRECISION_MIXED, PERI_PRECISION_SINGLE};
    for (int k = 0; k < 3; ++k) {
        peri_body *a = flying(precisions[k], PERI_UNLOADING_SECANT), *b = flying(precisions[k], PERI_UNLOADING_SECANT), *c = NULL;
        const double half[2] = {5, 7}, fast[2] = {0.03, 0.01}, none[2] = {0, 0};
        const double step = 0.5 * peri_stable_step(a);
        run(a, 60, step);
        (void)MUST(a, peri_body_clone(a, &c, NULL));
        written = taken = 0;
        (void)MUST(a, peri_save_state_to(a, keep, NULL));
        (void)MUST(b, peri_load_state_from(b, take, NULL));
        run(a, 60, step);
        run(b, 60, step);
        run(c, 60, step);
        same_motion(a, b);
        same_motion(a, c);
        (void)MUST(b, peri_reset(b));
        (void)MUST(b, peri_add_velocity(b, peri_select_box(b, NULL, none, half), fast));
        run(b, 120, step);
        same_motion(a, b);
        peri_body_destroy(a);
        peri_body_destroy(b);
        peri_body_destroy(c);
    }
}

/* Stretched alike in all directions every bond is softened alike: damage is what they lost of their stiffness. */
static void damage_is_lost_stiffness(void) {
    const peri_softening_desc d = soft(PERI_SOFTENING_BILINEAR, 60 * STRENGTH * STRENGTH / YOUNG);
    strip s = strip_of(3.015, 6, 8, 1, PERI_CORRECTION_NONE, &d);
    double u[128], x[128], damage[64], first, last;
    (void)MUST(s.body, peri_set_no_fail(s.body, PERI_ALL, 0));
    (void)MUST(s.body, peri_get_softening(s.body, s.material, s.material, &first, &last));
    const double stretch = 0.3 * first + 0.7 * last, left = first * (last - stretch) / (last - first) / stretch;
    (void)MUST(s.body, peri_get_field(s.body, PERI_FIELD_POSITION, x, 128));
    for (int k = 0; k < 128; ++k) u[k] = stretch * x[k];
    peri_evaluate_desc e;
    peri_evaluate_desc_init(&e);
    e.displacement = u;
    e.fracture = 1;
    (void)MUST(s.body, peri_evaluate(s.body, &e, NULL));
    (void)MUST(s.body, peri_get_field(s.body, PERI_FIELD_DAMAGE, damage, 64));
    for (int k = 0; k < 64; ++k) CHECK_NEAR(damage[k], 1 - left, 1e-9, 0);
    peri_body_destroy(s.body);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(bilinear_takes_its_energy);
    RUN(tables_take_their_energy);
    LONG_RUN(all_shapes_take_their_energy);
    RUN(strength_is_that_of_a_bar);
    RUN(one_bond_follows_its_curve);
    RUN(cycles_never_win);
    RUN(too_large_a_horizon_is_said);
    RUN(tangents_are_derivatives);
    RUN(motion_conserves);
    RUN(history_is_kept);
    RUN(damage_is_lost_stiffness);
    return test_end("test_softening");
}
