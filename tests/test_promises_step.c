/* SPDX-License-Identifier: MIT */
/* test_promises_step.c - what the manual says of the step: how sharp it is, what it costs, when it is looked at anew, what safety buys.
   SOURCE OF TRUTH: an explicit step is stable up to 2/sqrt(L), L the largest eigenvalue of M^-1 K by the power method; the bits of
   peri_stable_step from step to step; and runs of the same body with a tenth of the step. */
#include "specimen.h"
#include "stiffest.h"
#include <time.h>

static double *get(peri_body *b, int32_t field) {
    const int64_t n = peri_size_of_field(b, field);
    double *out = (double *)calloc((size_t)n + 1, sizeof *out);
    MUST(b, peri_get_field(b, field, out, n));
    return out;
}
static void put(peri_body *b, int32_t field, const double *value) {
    MUST(b, peri_set_field(b, field, value, peri_size_of_field(b, field)));
}

/* A field that is `rate` times the place. */
static void spread(peri_body *b, int32_t field, double rate) {
    double *x = get(b, PERI_FIELD_POSITION);
    for (int64_t k = 0; k < peri_size_of_field(b, PERI_FIELD_POSITION); ++k) x[k] *= rate;
    put(b, field, x);
    free(x);
}

static double true_limit(peri_body *b) { return 2 / sqrt(stiffest(b, 0, 250)); }

static specimen box_of(int32_t law, int32_t space, double poisson, double reach) {
    if (space == PERI_SPACE_SOLID) return specimen_of(space, law, poisson, 1, reach, 7, 8, 9);
    return specimen_of(space, law, poisson, 1, reach, 20, 24, 1);
}

/* "Within 1.04 of the true limit where bonds can only soften the body or cannot break; short of it by 1.23 to 1.30 where LPS and Oterkus
   bonds can break, by 1.7 to 2.1 in correspondence." */
static void sharpness_in_numbers(void) {
    double least[3] = {9, 9, 9}, most[3] = {0, 0, 0};
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law)
        for (int32_t space = PERI_SPACE_PLANE_STRAIN; space <= PERI_SPACE_SOLID; ++space)
            for (int k = 0; k < 4; ++k) {
                const int breaks = k % 2, kind = !breaks || law == PERI_LAW_BOND_BASED ? 0 : law == PERI_LAW_CORRESPONDENCE ? 2 : 1;
                specimen s = box_of(law, space, k / 2 ? 0.3 : 0.1, 3);
                s.desc.geometry = PERI_GEOMETRY_LINEAR;
                if (breaks) s.material.critical_stretch = 0.1;
                peri_body *b = specimen_make(&s);
                const double ratio = true_limit(b) / peri_stable_step(b);
                least[kind] = fmin(least[kind], ratio);
                most[kind] = fmax(most[kind], ratio);
                peri_body_destroy(b);
            }
    for (int kind = 0; kind < 3; ++kind) printf("    true limit over stable step: %.3f to %.3f\n", least[kind], most[kind]);
    CHECK(least[0] >= 1 && most[0] <= 1.045);
    CHECK(least[1] >= 1.22 && most[1] <= 1.32);
    CHECK(least[2] >= 1.65 && most[2] <= 2.15);
}

/* "Bonds that break in a bond-based body leave it as it is", in a state-based one it never grows. Torn apart
   in the middle. */
static void bonds_that_break(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        specimen s = box_of(law, PERI_SPACE_PLANE_STRAIN, 0.2, 3);
        s.desc.geometry = PERI_GEOMETRY_LINEAR;
        s.material.critical_stretch = 0.02;
        peri_body *b = specimen_make(&s);
        const double before = peri_stable_step(b);
        peri_advance_desc r;
        double *v = get(b, PERI_FIELD_POSITION);
        for (int64_t k = 0; k < peri_size_of_field(b, PERI_FIELD_POSITION); ++k) v[k] = k % 2 ? 0 : v[k] > 10 ? 0.05 : -0.05;
        put(b, PERI_FIELD_VELOCITY, v);
        peri_advance_desc_init(&r);
        r.steps = 30;
        MUST(b, peri_advance(b, &r));
        CHECK(peri_broken_count(b) > 20);
        if (law == PERI_LAW_BOND_BASED) CHECK(peri_stable_step(b) == before);
        else CHECK(peri_stable_step(b) <= before); /* falls: test_fragments.c */
        free(v);
        peri_body_destroy(b);
    }
}

/* "Looked at after a change by you and every 32 steps (8 in correspondence)". */
static void looks(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        const int every = law == PERI_LAW_CORRESPONDENCE ? 8 : 32;
        specimen s = box_of(law, PERI_SPACE_PLANE_STRAIN, 0.2, 3);
        peri_body *b = specimen_make(&s);
        const double rest = peri_stable_step(b);
        double step = rest;
        int changes = 0, odd = 0, phase = -1;
        peri_advance_desc r;
        spread(b, PERI_FIELD_VELOCITY, 0.03);
        CHECK(peri_stable_step(b) == rest); /* velocities are not stretches */
        peri_advance_desc_init(&r);
        r.steps = 1;
        r.time_step = 0.2 * rest;
        for (int n = 1; n <= 96; ++n) {
            MUST(b, peri_advance(b, &r));
            const double now = peri_stable_step(b);
            if (now == step) continue;
            step = now;
            CHECK(phase >= 0 || n >= every);
            if (phase < 0) phase = n % every;
            CHECK(n % every == phase);
            odd += n / every % 2;
            changes++;
        }
        CHECK(changes >= 1 && (every == 32 || (changes > 4 && odd > 0 && odd < changes)) && step < rest);
        MUST(b, peri_reset(b));
        CHECK(peri_stable_step(b) == rest);
        spread(b, PERI_FIELD_DISPLACEMENT, 0.01); /* "by more than some percent" */
        CHECK(law == PERI_LAW_CORRESPONDENCE || peri_stable_step(b) == rest);
        spread(b, PERI_FIELD_DISPLACEMENT, 0.4);
        CHECK(peri_stable_step(b) < 0.97 * rest);
        spread(b, PERI_FIELD_DISPLACEMENT, -0.3);
        CHECK(law == PERI_LAW_CORRESPONDENCE || peri_stable_step(b) < 0.97 * rest);
        peri_body_destroy(b);
    }
}

/* safety: "0.5 has a third of the error of 0.9": of a swinging plate, by its displacements. */
static double *swung(double safety) {
    specimen s = box_of(PERI_LAW_LPS, PERI_SPACE_PLANE_STRAIN, 0.2, 3);
    peri_body *b = specimen_make(&s);
    peri_advance_desc r;
    double *v = get(b, PERI_FIELD_POSITION);
    for (int64_t k = 0; k < peri_size_of_field(b, PERI_FIELD_POSITION); ++k) v[k] = 1e-5 * cos(acos(-1.0) * v[k] / (k % 2 ? 24 : 20));
    put(b, PERI_FIELD_VELOCITY, v);
    free(v);
    peri_advance_desc_init(&r);
    r.safety = safety;
    r.duration = 300;
    MUST(b, peri_advance(b, &r));
    v = get(b, PERI_FIELD_DISPLACEMENT);
    peri_body_destroy(b);
    return v;
}
static void error_by_safety(void) {
    double *all[3] = {swung(0.9), swung(0.5), swung(0.05)}, off[2] = {0, 0};
    for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 2 * 20 * 24; ++k) off[j] = fmax(off[j], fabs(all[j][k] - all[2][k]));
    printf("    error of 0.5 over that of 0.9: %.3f\n", off[1] / off[0]);
    CHECK_NEAR(off[1] / off[0], 1.0 / 3, 0, 0.07); /* (0.5/0.9)^2 = 0.31 */
    for (int j = 0; j < 3; ++j) free(all[j]);
}

/* "The first call ... makes an estimate, in the time of 20 to 100 steps"; a second costs nothing. Busy machines are noisy. */
static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }
static void cost_of_the_estimate(void) {
    for (int32_t law = PERI_LAW_BOND_BASED; law < peri__end_law; ++law) {
        specimen s = specimen_of(PERI_SPACE_SOLID, law, 0.2, 1, 3, 32, 32, 32);
        double first = HUGE_VAL, again = HUGE_VAL, step = HUGE_VAL;
        for (int k = 0; k < 3; ++k) {
            peri_body *b = specimen_make(&s);
            peri_advance_desc r;
            double from = seconds();
            (void)peri_stable_step(b);
            first = fmin(first, seconds() - from);
            from = seconds();
            (void)peri_stable_step(b);
            again = fmin(again, seconds() - from);
            peri_advance_desc_init(&r);
            r.steps = 20;
            from = seconds();
            MUST(b, peri_advance(b, &r));
            step = fmin(step, (seconds() - from) / 20);
            peri_body_destroy(b);
        }
        printf("    law %d: %.0f steps\n", (int)law, first / step);
        CHECK(first / step > 8 && first / step < 150);
        CHECK(again < 0.1 * step);
    }
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(sharpness_in_numbers);
    RUN(bonds_that_break);
    RUN(looks);
    RUN(error_by_safety);
    LONG_RUN(cost_of_the_estimate);
    return test_end("test_promises_step");
}
