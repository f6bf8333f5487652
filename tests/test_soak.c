/* SPDX-License-Identifier: MIT */
/* test_soak.c - a small body that is shaken for a very long time and breaks on the way, ten thousand steps, or a million (--long).

   SOURCE OF TRUTH: conservation laws. A free body keeps its momentum and angular momentum to the rounding of its steps; velocity Verlet at
   the part s of its stable step keeps the energy of each mode within s^2/(1 - s^2), so the ledger stays as near, however many the steps;
   bonds that broke stay broken; and peri.h: the same bits for any number of threads, and for one long run against several short ones. */
#include "scene.h"

#define SAFETY 0.2
#define SHAKES 20 /* times that the body is shaken in a run                                                               */

typedef struct soaked {
    uint64_t bits[SHAKES];
    int64_t  broken, bonds;
} soaked;

static uint64_t digest(const double *x, int64_t n, uint64_t bits) {
    for (int64_t k = 0; k < n; ++k) {
        uint64_t word;
        memcpy(&word, &x[k], sizeof word);
        bits = (bits ^ word) * UINT64_C(0x9E3779B97F4A7C15);
        bits ^= bits >> 29;
    }
    return bits;
}

/* Momentum about the origin, and (scale) the sums of the sizes of its terms. All points weigh the same, and the thickness is 1. */
static void momenta(peri_body *b, const double *x, const double *u, const double *v, double *sum, double *scale) {
    const int64_t n = peri_point_count(b);
    sum[0] = sum[1] = sum[2] = scale[0] = scale[2] = 0;
    for (int64_t i = 0; i < n; ++i) {
        const double y[2] = {x[2 * i] + u[2 * i], x[2 * i + 1] + u[2 * i + 1]};
        const double fast = fabs(v[2 * i]) + fabs(v[2 * i + 1]);
        sum[0] += v[2 * i];
        sum[1] += v[2 * i + 1];
        sum[2] += y[0] * v[2 * i + 1] - y[1] * v[2 * i];
        scale[0] += fast;
        scale[2] += fast * (fabs(y[0]) + fabs(y[1]));
    }
    scale[1] = scale[0];
}

/* Sets all in motion, without momentum: noise, in pairs of points that share it. */
static void shake(peri_body *b, double *v, int round) {
    const int64_t n = peri_point_count(b);
    uint64_t state = (uint64_t)round + 1;
    for (int64_t i = 0; i + 1 < n; i += 2)
        for (int d = 0; d < 2; ++d) {
            const double kick = 0.008 * (2 * test_random(&state) - 1);
            v[2 * i + d] += kick;
            v[2 * i + 2 + d] -= kick;
        }
    put(b, PERI_FIELD_VELOCITY, v);
}

/* `steps` steps in SHAKES runs, each in `parts` calls. */
static soaked soak(int32_t law, int64_t steps, int32_t threads, int64_t parts) {
    soaked out;
    specimen s = specimen_of(PERI_SPACE_PLANE_STRESS, law, 0.2, 1, 2.2, 10, 6, 1);
    s.desc.threads = threads;
    s.material.critical_stretch = 0.05;
    peri_body *b = specimen_make(&s);
    const int64_t points = peri_point_count(b), n = 2 * points;
    double *x = get(b, PERI_FIELD_POSITION), *former = get(b, PERI_FIELD_DAMAGE);
    peri_advance_desc r;
    double most = SAFETY;
    memset(&out, 0, sizeof out);
    peri_advance_desc_init(&r);
    r.steps = steps / SHAKES / parts;
    for (int round = 0; round < SHAKES; ++round) {
        double before[3], after[3], scale[3], late[3], *u = get(b, PERI_FIELD_DISPLACEMENT), *v = get(b, PERI_FIELD_VELOCITY);
        peri_energy e;
        shake(b, v, round);
        r.time_step = SAFETY * peri_stable_step(b); /* a run of its own would take the step that fits where it begins */
        momenta(b, x, u, v, before, scale);
        free(u), free(v);
        for (int64_t part = 0; part < parts; ++part) MUST(b, peri_advance(b, &r));
        u = get(b, PERI_FIELD_DISPLACEMENT), v = get(b, PERI_FIELD_VELOCITY);
        double *damage = get(b, PERI_FIELD_DAMAGE);
        momenta(b, x, u, v, after, late);
        /* each step adds forces of the order of the change of velocity in a step, and rounds it some 100 times */
        for (int d = 0; d < 3; ++d) CHECK_NEAR(after[d], before[d], 0, 100 * ULP64 * (double)(steps / SHAKES) * (scale[d] + late[d]));
        MUST(b, peri_get_energy(b, &e));
        const double part = r.time_step / peri_stable_step(b); /* larger where state-based families have lost bonds */
        most = fmax(most, part);
        CHECK(fabs(e.error) <= most * most / (1 - most * most) * (e.kinetic + e.elastic + e.fracture));
        CHECK(e.initial > 0 && e.kinetic >= 0 && e.elastic >= 0);
        for (int64_t i = 0; i < points; ++i) CHECK(damage[i] >= former[i] && damage[i] <= 1);
        for (int64_t k = 0; k < n; ++k) CHECK(isfinite(u[k]) && isfinite(v[k]));
        CHECK(peri_broken_count(b) >= out.broken);
        out.broken = peri_broken_count(b);
        out.bits[round] = digest(damage, points, digest(v, n, digest(u, n, 1)));
        free(u), free(v), free(former);
        former = damage;
    }
    out.bonds = peri_bond_count(b);
    CHECK(peri_step_count(b) == steps && out.broken > 0 && out.broken < out.bonds);
    free(x), free(former);
    peri_body_destroy(b);
    return out;
}

static void soak_twice(int32_t law, int64_t steps) {
    const soaked one = soak(law, steps, 1, 1), other = soak(law, steps, 3, 5);
    CHECK(one.broken == other.broken && memcmp(one.bits, other.bits, sizeof one.bits) == 0);
    printf("    %s: %d steps, %d bonds broken of %d\n", law_name[law % 100], (int)steps, (int)one.broken, (int)one.bonds);
}

static void ten_thousand_steps(void) {
    soak_twice(PERI_LAW_BOND_BASED, 10000);
    soak_twice(PERI_LAW_OTERKUS, 10000);
}
static void a_million_steps(void) {
    for (int32_t law = peri__first_law; law < peri__end_law; ++law) soak_twice(law, 1000000);
}

int main(int argc, char **argv) {
    test_begin(argc, argv);
    RUN(ten_thousand_steps);
    LONG_RUN(a_million_steps);
    return test_end("test_soak");
}
