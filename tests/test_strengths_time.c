/* SPDX-License-Identifier: MIT */
/* test_strengths_time.c - critical stretches that depend on more than the stretch: on what is pressed sideways, on the rate, on how long.

   SOURCE OF TRUTH: closed forms of uniform strain, the geometry being linear. Confined (Silling, Askari 2005, and pair_style peri/pmb of
   LAMMPS): s00 - alpha s_min, s_min the least stretch of the bonds of an end; a bond takes the lower s0 of its ends. Rate: s0 (1 +
   (r/rate)^power). Delay: a body that stretches at the rate r is over s0 from s0/r on. */
#include "solid.h"
#include "equilibrium.h"

#define S0 0.01

static specimen linear_box(int32_t law) {
    solid s = solid_of(PERI_SPACE_PLANE_STRESS, law, PERI_CORRECTION_NONE);
    specimen p = solid_specimen(&s, 7, 6, 1);
    p.material.critical_stretch = S0;
    return p;
}

/* Bonds that break under the strain (x, y), in a step of dt that came there at the rate `rate` of the same. */
static int64_t breaks_at(peri_body *b, double x, double y, double rate, double dt) {
    const double h[4] = {x, 0, 0, y};
    const int64_t n = 2 * peri_point_count(b);
    double *v, *impulse = (double *)calloc((size_t)n, sizeof *impulse);
    peri_evaluate_desc e;
    peri_evaluate_report r;
    int64_t i;
    MUST(b, peri_reset(b));
    stretch_by(b, h);
    v = get(b, PERI_FIELD_DISPLACEMENT);
    for (i = 0; i < n; ++i) v[i] *= x != 0 ? rate / x : 0;
    peri_evaluate_desc_init(&e);
    e.fracture = 1;
    if (dt > 0) e.time_step = dt, e.velocity = v, e.impulse = impulse;
    MUST(b, peri_evaluate(b, &e, &r));
    free(v);
    free(impulse);
    return r.broken;
}

static void what_is_pressed_bears_more(void) {
    for (int32_t law = peri__first_law; law < peri__end_law; ++law) {
        static const double side[4] = {-0.02, -0.005, 0, 0.5}; /* the last: times x */
        specimen p = linear_box(law);
        p.material.criterion = PERI_CRITERION_CONFINED_STRETCH;
        p.material.compression = 0.25;
        peri_body *b = specimen_make(&p);
        double s0 = 0;
        MUST(b, peri_get_bond_constants(b, peri_id(b, PERI_KIND_MATERIAL, 1), peri_id(b, PERI_KIND_MATERIAL, 1), NULL, &s0));
        CHECK_NEAR(s0, S0, 1e-15, 0);
        for (int k = 0; k < 4; ++k) {
            /* x + alpha least = s00, least = y */
            const double x = k == 3 ? S0 / (1 + 0.25 * side[k]) : S0 - 0.25 * side[k], y = k == 3 ? side[k] * x : side[k];
            CHECK(breaks_at(b, x * (1 - 1e-6), y * (1 - (k == 3) * 1e-6), 0, 0) == 0);
            /* bonds along x alone: their second neighbours and the third are no longer stretched: 6 rows of 6 + 5 + 4 */
            CHECK(breaks_at(b, x * (1 + 1e-6), y * (1 + (k == 3) * 1e-6), 0, 0) == 6 * (6 + 5 + 4));
        }
        CHECK(breaks_at(b, 0, -10 * S0, 0, 0) == 0); /* shortened bonds never break */
        peri_body_destroy(b);
    }
}

static void what_is_fast_bears_more(void) {
    static const double power[3] = {0, 0.5, 2}; /* 0: the default, 1 */
    for (int k = 0; k < 3; ++k)
        for (int32_t law = peri__first_law; law < peri__end_law; ++law) {
            specimen p = linear_box(law);
            const double rate = 0.3, expected = S0 * (1 + pow(rate / 2.0, power[k] > 0 ? power[k] : 1));
            p.material.criterion = PERI_CRITERION_RATE_STRETCH;
            p.material.rate = 2;
            p.material.rate_power = power[k];
            peri_body *b = specimen_make(&p);
            CHECK(breaks_at(b, expected * (1 - 1e-6), 0, rate, 1e-4) == 0 && breaks_at(b, expected * (1 + 1e-6), 0, rate, 1e-4) == 90);
            CHECK(breaks_at(b, S0 * (1 + 1e-6), 0, -rate, 1e-4) == 90); /* what gets shorter again: as at rest */
            CHECK(breaks_at(b, S0 * (1 - 1e-6), 0, 0, 0) == 0 && breaks_at(b, S0 * (1 + 1e-6), 0, 0, 0) == 90);
            peri_body_destroy(b);
        }
}

typedef struct driven {
    const double *x;
    double        rate, back; /* from the time `back` on it goes back */
} driven;
static int32_t drive(void *user, double time, int64_t count, const int32_t *points, double *value) {
    const driven *d = (const driven *)user;
    for (int64_t k = 0; k < count; ++k) {
        value[2 * k] = d->x[2 * points[k]] * d->rate * (time <= d->back ? time : 2 * d->back - time);
        value[2 * k + 1] = 0;
    }
    return 0;
}

typedef struct times {
    double  first, last;
    int64_t count;
} times;
static int32_t note_times(void *user, int32_t i, int32_t j, double time, double stretch) {
    times *t = (times *)user;
    (void)i, (void)j, (void)stretch;
    if (t->count++ == 0) t->first = time;
    t->last = time;
    return 0;
}

/* Stretched at the rate r, all bonds along x break when they have been over s0 for the delay: within the step that follows. */
static void what_is_short_bears_more(void) {
    for (int32_t law = peri__first_law; law < peri__end_law; ++law)
        for (int way = 0; way < 4; ++way) {
            specimen p = linear_box(law);
            const double rate = 0.02, delay = 0.403, dt = 0.015, met = S0 / rate, back = way == 1 ? met + 0.15 : way == 2 ? met + 0.3 : 1e9;
            times t = {0, 0, 0};
            peri_advance_desc a;
            p.material.criterion = PERI_CRITERION_DELAYED_STRETCH;
            p.material.delay = delay;
            if (way == 3) p.desc.precision = PERI_PRECISION_SINGLE;
            peri_body *b = specimen_make(&p);
            double *x = get(b, PERI_FIELD_POSITION);
            driven d = {x, rate, back};
            MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, drive, &d));
            MUST(b, peri_on_break(b, note_times, &t));
            peri_advance_desc_init(&a);
            a.steps = 80; /* to 1.2: s0 at 0.5, the end at 0.9 */
            a.time_step = dt;
            a.force_step = 1;
            MUST(b, peri_advance(b, &a));
            /* way 1: over it from met to met + 0.3, too short; way 2: to met + 0.6 and so long enough */
            if (way == 1) CHECK(t.count == 0);
            else {
                CHECK(t.count >= 90 && t.first > met + delay - 1e-6 && t.first <= met + delay + dt * (1 + 1e-6));
            }
            free(x);
            peri_body_destroy(b);
        }
}

/* In equilibria, which last for ever, and at no rate. */
static void equilibria_wait(void) {
    static const int32_t criteria[3] = {PERI_CRITERION_CONFINED_STRETCH, PERI_CRITERION_RATE_STRETCH, PERI_CRITERION_DELAYED_STRETCH};
    for (int k = 0; k < 3; ++k) {
        specimen p = linear_box(PERI_LAW_LPS);
        times t = {0, 0, 0};
        peri_solve_desc st = statics_of(1e-9);
        peri_solve_report r;
        p.material.criterion = criteria[k];
        if (k == 0) p.material.compression = 0.25;
        if (k == 1) p.material.rate = 1;
        if (k == 2) p.material.delay = 100;
        peri_body *b = specimen_make(&p);
        double *x = get(b, PERI_FIELD_POSITION);
        driven d = {x, 1, 1e9};
        MUST(b, peri_prescribe_displacement(b, PERI_ALL, PERI_AXIS_XY, NULL, drive, &d));
        MUST(b, peri_on_break(b, note_times, &t));
        st.control = PERI_CONTROL_FRACTURE;
        st.load_to = 0.03;
        st.breaks = 1;
        memset(&r, 0, sizeof r);
        (void)peri_solve(b, &st, &r);
        CHECK_NEAR(t.first, S0, 1e-6, 0);
        CHECK(r.broken == 90);
        free(x);
        peri_body_destroy(b);
    }
}

/* Is the bond, by the deformation that all points have: s + alpha least, least the higher of what both ends have? By the definition alone,
   from positions and displacements; all ways in which the ends differ, and either may come first. */
static int64_t breaks_by_hand(int64_t n, const double *x, const double *u, double horizon, double alpha, double s00) {
    double least[64];
    int64_t count = 0;
    CHECK(n <= 64);
    for (int pass = 0; pass < 2 && n <= 64; ++pass)
        for (int64_t i = 0; i < n; ++i) {
            if (pass == 0) least[i] = HUGE_VAL;
            for (int64_t j = 0; j < n; ++j) {
                const double xi[2] = {x[2 * j] - x[2 * i], x[2 * j + 1] - x[2 * i + 1]}, square = xi[0] * xi[0] + xi[1] * xi[1];
                if (i == j || square > horizon * horizon * (1 + 1e-12)) continue;
                const double s = (xi[0] * (u[2 * j] - u[2 * i]) + xi[1] * (u[2 * j + 1] - u[2 * i + 1])) / square;
                if (pass == 0) least[i] = fmin(least[i], s);
                else count += i < j && s > 0 && s + alpha * fmax(least[i], least[j]) > s00;
            }
        }
    return count;
}

static void the_end_that_has_more_decides(void) {
    for (int32_t law = peri__first_law; law < peri__end_law; ++law) {
        specimen p = linear_box(law);
        uint64_t dice = 7;
        peri_evaluate_desc e;
        p.material.criterion = PERI_CRITERION_CONFINED_STRETCH;
        p.material.compression = 0.6;
        peri_body *b = specimen_make(&p);
        const int64_t n = peri_point_count(b);
        double *x = get(b, PERI_FIELD_POSITION), *u = get(b, PERI_FIELD_DISPLACEMENT);
        int64_t seen = 0;
        for (int k = 0; k < 6; ++k) {
            MUST(b, peri_reset(b));
            for (int64_t i = 0; i < 2 * n; ++i) u[i] = S0 * (x[i] + H * (3 + k) * (test_random(&dice) - 0.5));
            peri_evaluate_desc_init(&e);
            e.fracture = 1;
            e.displacement = u;
            MUST(b, peri_evaluate(b, &e, NULL));
            const int64_t expected = breaks_by_hand(n, x, u, p.desc.horizon, 0.6, S0);
            CHECK(peri_broken_count(b) == expected);
            seen += expected > 20 && expected < peri_entry_count(b) / 4;
        }
        CHECK(seen == 6);
        free(x), free(u);
        peri_body_destroy(b);
    }
}

/* Two materials, side by side: bonds between them are those of the lower limit, with what goes with it. */
static void between_materials(void) {
    for (int swap = 0; swap < 2; ++swap) {
        specimen p = linear_box(PERI_LAW_LPS);
        const double lo[2] = {0, 0}, middle[2] = {7 * H, 3 * H}, left[2] = {0, 3 * H}, hi[2] = {7 * H, 6 * H};
        peri_body *b = NULL;
        peri_material_desc weak = p.material, strong = p.material;
        weak.criterion = strong.criterion = PERI_CRITERION_CONFINED_STRETCH;
        weak.compression = 0.5;
        strong.critical_stretch = 2 * S0;
        MUST(NULL, peri_body_create(&p.desc, &b, NULL));
        const int32_t first = (int32_t)MUST(b, peri_add_material(b, swap ? &strong : &weak));
        const int32_t second = (int32_t)MUST(b, peri_add_material(b, swap ? &weak : &strong));
        MUST(b, peri_add_box(b, first, lo, middle, H));
        MUST(b, peri_add_box(b, second, left, hi, H));
        MUST(b, peri_build(b));
        /* along y: x pressed by 0.01: the weak at s00 + 0.5 * 0.01 = 1.5 S0, the strong at 2 S0 */
        CHECK(breaks_at(b, -S0, 1.5 * S0 * (1 - 1e-6), 0, 0) == 0);
        /* of 5 + 4 + 3 bonds of a column along y the strong half has 2 + 1 */
        CHECK(breaks_at(b, -S0, 1.5 * S0 * (1 + 1e-6), 0, 0) == 7 * (12 - 3));
        CHECK(breaks_at(b, -S0, 2 * S0 * (1 + 1e-6), 0, 0) > 7 * (12 - 3));
        peri_body_destroy(b);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(what_is_pressed_bears_more);
    RUN(what_is_fast_bears_more);
    RUN(what_is_short_bears_more);
    RUN(equilibria_wait);
    RUN(the_end_that_has_more_decides);
    RUN(between_materials);
    return test_end("test_strengths_time");
}
